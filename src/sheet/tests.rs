//! The finished sheets of the examples, as a reader sees them.

use std::path::{Path, PathBuf};

use super::figure::{Figure, Group, Mark, Node, Shape};
use super::overlap::overlaps;
use super::{Language, figure_names, film, question, scale, single, solution, step_by_step};
use crate::graphical::construction::{CentrePlace, Construction};
use crate::graphical::{construct, extents};
use crate::mechanism::quantity::{Answer, DiagramKind};
use crate::mechanism::structure::Structure;
use crate::plan::{Extent, Plan};
use crate::render::svg;
use crate::render::theme::Theme;
use crate::scene::{self, Scene};
use crate::sweep::other_positions;

fn solved(path: &Path) -> Option<(Scene, Construction)> {
    solved_text(&std::fs::read_to_string(path).unwrap())
}

fn solved_text(text: &str) -> Option<(Scene, Construction)> {
    let scene = scene::read(text, "test").unwrap();
    let structure = Structure::of(&scene.mechanism).ok()?;
    let plan = Plan::new(&scene.mechanism, &structure, Extent::WholeSkeleton);
    let (positions, assembly) = (&scene.sheet.positions, scene.sheet.other_assembly);
    let others = other_positions(&scene.mechanism, positions, assembly).unwrap();
    let extents = extents(&scene.mechanism, &structure, &plan).ok()?.with(&others);
    let scales = scale::for_scene(&scene, extents);
    let mut construction = construct(&scene.mechanism, &structure, &plan, scales).ok()?.construction;
    construction.others = others;
    Some((scene, construction))
}

/// Folders of scenes that have sheets.
const SCENES: [&str; 9] = [
    "examples",
    "examples/centres",
    "examples/constructions",
    "examples/errata",
    "examples/exam",
    "examples/forces",
    "examples/pairs",
    "src/catalogue",
    "src/sheet/tests",
];

fn scenes() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all: Vec<PathBuf> = SCENES
        .iter()
        .flat_map(|folder| std::fs::read_dir(root.join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .collect();
    all.sort();
    assert!(!all.is_empty());
    all
}

fn problem_3_1() -> (Scene, Construction) {
    solved(&Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/s000-ch3a-1.json")).unwrap()
}

fn figures(scene: &Scene, construction: &Construction) -> Vec<(String, Figure)> {
    let mut all = vec![
        ("sheet".to_owned(), solution(scene, construction, Language::English)),
        ("question".to_owned(), question(scene, construction, Language::English)),
    ];
    for name in figure_names() {
        if let Some(figure) = single(scene, construction, name, Language::English) {
            all.push(((*name).to_owned(), figure));
        }
    }
    all
}

/// `work` on every scene, on all processors; what it reports, in the order of the scenes.
fn on_all_scenes(work: impl Fn(&Scene, &Construction, &str) -> Vec<String> + Sync) -> Vec<String> {
    let scenes = scenes();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let found = std::sync::Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                while let Some(path) = scenes.get(next.fetch_add(1, std::sync::atomic::Ordering::Relaxed)) {
                    let Some((scene, construction)) = solved(path) else { continue };
                    let name = path.display();
                    let own: Vec<String> =
                        work(&scene, &construction, &std::fs::read_to_string(path).unwrap())
                            .into_iter()
                            .map(|what| format!("{name} {what}"))
                            .collect();
                    found.lock().unwrap().extend(own);
                }
            });
        }
    });
    let mut found = found.into_inner().unwrap();
    found.sort();
    found
}

#[test]
fn no_text_touches_ink_or_text_or_the_edge() {
    let bad = on_all_scenes(|scene, construction, _| {
        let mut figures = figures(scene, construction);
        for language in Language::ALL {
            let tag = language.words().tag;
            figures.push((format!("sheet {tag}"), solution(scene, construction, language)));
            figures.push((format!("question {tag}"), question(scene, construction, language)));
        }
        figures.push(("step by step".to_owned(), step_by_step(scene, construction, Language::English)));
        let film = film(scene, construction, Language::English).into_iter().enumerate();
        figures.extend(film.map(|(i, frame)| (format!("frame {i}"), frame)));
        let all = figures.iter().flat_map(|(name, figure)| {
            overlaps(figure).into_iter().map(move |overlap| format!("{name}: {overlap:?}"))
        });
        all.collect()
    });
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn every_character_has_a_glyph() {
    let bad = on_all_scenes(|scene, construction, _| {
        let mut bad = Vec::new();
        for language in Language::ALL {
            for figure in [solution(scene, construction, language), question(scene, construction, language)] {
                figure.root.walk(&mut |node| {
                    let Node::Text(text) = node else { return };
                    for run in &text.runs {
                        let lacks = |c: &char| !run.face.has(*c) && *c != '\u{200c}';
                        bad.extend(
                            run.text.chars().filter(lacks).map(|c| format!("{c:?} in {:?}", run.text)),
                        );
                    }
                });
            }
        }
        bad
    });
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

#[test]
fn every_notation_and_the_decimal_comma_are_drawn_clear_of_ink() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples");
    for (name, notation, seen) in [
        ("s000-ch3a-1", "norton", "OV"),
        ("s000-ch3a-2", "uicker", "VA2/4"),
        ("s000-ch3a-1", "rattan", "vba"),
        ("s000-ch3a-1", "martin", "VB/A"),
    ] {
        let (mut scene, construction) = solved(&folder.join(format!("{name}.json"))).unwrap();
        scene.sheet.notation = Some(notation.to_owned());
        scene.sheet.decimal_comma = true;
        let figure = solution(&scene, &construction, Language::English);
        assert_eq!(overlaps(&figure), vec![], "{notation}");
        let mut texts = Vec::new();
        figure.root.walk(&mut |node| {
            if let Node::Text(text) = node {
                texts.push(text.content());
            }
        });
        assert!(texts.iter().any(|text| text == seen), "{notation}: {seen}");
        assert!(texts.iter().any(|text| text.contains("44,6")) || name != "s000-ch3a-1", "{notation}");
        let digits = |c: char| c.is_ascii_digit();
        let point = |text: &String| {
            text.split('.')
                .collect::<Vec<_>>()
                .windows(2)
                .any(|pair| pair[0].ends_with(digits) && pair[1].starts_with(digits))
        };
        assert!(!texts.iter().any(point), "{notation}");
    }
}

/// A number as a person or a machine may have written it, without its sign.
fn writings(value: f64) -> Vec<String> {
    let size = value.abs();
    let mut all: Vec<String> = (3..=10)
        .map(|digits| {
            let rounded: f64 = format!("{size:.*e}", digits - 1).parse().unwrap();
            format!("{rounded}")
        })
        .collect();
    all.push(format!("{size}"));
    all.extend((1..=4).map(|decimals| format!("{size:.decimals$}")));
    all.retain(|text| text.chars().filter(char::is_ascii_digit).count() >= 3);
    all.sort();
    all.dedup();
    all
}

/// What a reader or a program may take out of a question: its words, titles and attributes, and all its bytes.
fn tokens(text: &str) -> std::collections::BTreeSet<String> {
    let number = |c: char| c.is_ascii_digit() || c == '.';
    text.split(|c| !number(c)).map(|t| t.trim_matches('.').to_owned()).filter(|t| !t.is_empty()).collect()
}

/// The numbers that a scene states outside of what somebody printed.
fn stated_numbers(text: &str) -> std::collections::BTreeSet<String> {
    let mut scene: serde_json::Value = serde_json::from_str(text).unwrap();
    scene.as_object_mut().unwrap().remove("published");
    tokens(&scene.to_string())
}

#[test]
fn a_question_gives_nothing_away() {
    let bad = on_all_scenes(|scene, construction, text| {
        let mut bad = Vec::new();
        for language in Language::ALL {
            let figure = question(scene, construction, language);
            let mut words = format!("{} {}", figure.title, figure.description);
            let mut leaking = Vec::new();
            told(&figure.root, &mut words, &mut leaking);
            bad.extend(leaking);
            // The ink is the same in all languages, and so is what a format makes of it.
            let once = language == Language::English;
            let words = tokens(&words);
            let [svg, bytes] = if once { all_bytes(&figure) } else { Default::default() };
            if once {
                bad.extend(told_to_programs(&figure));
            }
            let stated = stated_numbers(text);
            for (name, value) in computed(scene, construction) {
                for text in writings(value).into_iter().filter(|own| !stated.contains(own)) {
                    // Three figures may be met by chance among the coordinates of the drawing, seven may not, and eight
                    // not among those of outlined letters.
                    let figures = text.chars().filter(char::is_ascii_digit).count();
                    let met =
                        (figures >= 7 && svg.contains(&text)) || (figures >= 8 && bytes.contains(&text));
                    if words.contains(&text) || met {
                        bad.push(format!("{name} = {text}"));
                    }
                }
            }
        }
        bad
    });
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

/// Every number in the bytes of the figure as SVG, and in those of its other formats.
fn all_bytes(figure: &Figure) -> [std::collections::BTreeSet<String>; 2] {
    let svg = tokens(&svg::write(figure));
    let mut all = std::collections::BTreeSet::new();
    all.extend(tokens(&crate::render::tex::write(figure, Theme::Mono).unwrap_or_default()));
    all.extend(tokens(&crate::render::json::write(figure)));
    #[cfg(feature = "png")]
    all.extend(tokens(&crate::render::outline::write(figure, Theme::Mono).unwrap()));
    #[cfg(feature = "pdf")]
    all.extend(tokens(&String::from_utf8_lossy(
        &crate::render::pdf::render_plainly(figure, Theme::Mono).unwrap(),
    )));
    [svg, all]
}

/// The keys of answers in the JSON of a figure, which a question must not have, with something in them.
fn told_to_programs(figure: &Figure) -> Vec<String> {
    let json = crate::render::json::value(figure);
    let panels = json["pages"].as_array().unwrap().iter().flat_map(|page| page["panels"].as_array().unwrap());
    let answers =
        panels.flat_map(|panel| ["vectors", "lines"].map(|key| (key, panel[key].as_array().map(Vec::len))));
    answers.filter(|(_, count)| count.is_some_and(|n| n > 0)).map(|(key, _)| format!("JSON: {key}")).collect()
}

/// All that the figure says in words, and every attribute that it must not have.
fn told(group: &Group, words: &mut String, leaking: &mut Vec<String>) {
    // A load that is given is drawn with its value.
    if group.data.iter().any(|(name, value)| *name == "quantity" && value.starts_with("load(")) {
        return;
    }
    for (name, value) in &group.data {
        words.push_str(&format!(" {value} "));
        // A label tells whose name it is: a joint's or a link's.
        if !matches!(*name, "point" | "link" | "guide" | "page" | "of") {
            leaking.push(format!("data-{name}=\"{value}\""));
        }
    }
    words.push_str(group.title.as_deref().unwrap_or_default());
    for child in &group.children {
        match child {
            Node::Group(child) => told(child, words, leaking),
            Node::Text(text) => words.push_str(&format!(" {} ", text.content())),
            Node::Mark(_) => {}
        }
    }
}

/// Every velocity, acceleration and rotation that the solution finds, in the units of the scene.
fn computed(scene: &Scene, construction: &Construction) -> Vec<(String, f64)> {
    let (length, time) = (scene.units.length.si, scene.units.time.si);
    let mut all = Vec::new();
    for (polygon, unit) in [
        (construction.diagram(DiagramKind::Velocity), length / time),
        (construction.diagram(DiagramKind::Acceleration), length / (time * time)),
    ] {
        for vector in polygon.iter().flat_map(|p| p.vectors.iter().map(move |v| (p, v))) {
            let (p, v) = vector;
            let parts = [v.to[0] - v.from[0], v.to[1] - v.from[1]];
            let size = libm::hypot(parts[0], parts[1]);
            for mm in [parts[0], parts[1], size] {
                all.push((format!("{:?}", v.quantity), mm * p.si_per_mm / unit));
            }
        }
    }
    for centre in construction.circle.iter().flat_map(|circle| &circle.centres) {
        if let (CentrePlace::At(at), false) = (centre.place, centre.found.is_primary()) {
            let name = format!("centre {:?}", centre.links);
            all.extend(at.map(|mm| (name.clone(), mm * construction.space.metres_per_mm / length)));
        }
    }
    for (asked, reading) in scene.mechanism.asked.iter().zip(&construction.answers) {
        if asked.quantity.order() == crate::mechanism::quantity::Order::Position {
            continue;
        }
        match &reading.answer {
            Answer::Scalar { value, .. } => all.push((asked.name.clone(), value / asked.unit.si)),
            Answer::Vector { value, .. } => {
                all.extend(value.iter().map(|v| (asked.name.clone(), v / asked.unit.si)));
                all.push((asked.name.clone(), libm::hypot(value[0], value[1]) / asked.unit.si));
            }
            _ => {}
        }
    }
    all
}

#[test]
fn the_same_bytes_twice() {
    let (scene, construction) = problem_3_1();
    let (again, constructed_again) = problem_3_1();
    for ((name, one), (_, other)) in
        figures(&scene, &construction).iter().zip(&figures(&again, &constructed_again))
    {
        assert_eq!(svg::write(one), svg::write(other), "{name}");
    }
}

#[test]
fn unknown_figures_are_refused() {
    let (scene, construction) = problem_3_1();
    assert!(single(&scene, &construction, "portrait", Language::English).is_none());
}

#[test]
fn the_book_s_scales_are_chosen() {
    let (_, construction) = problem_3_1();
    let velocity = construction.diagram(DiagramKind::Velocity).unwrap().si_per_mm;
    let acceleration = construction.diagram(DiagramKind::Acceleration).unwrap().si_per_mm;
    let close = |a: f64, b: f64| (a - b).abs() < 1e-12 * b;
    assert!(close(construction.space.metres_per_mm, 0.01));
    assert!(close(velocity, 0.05) && close(acceleration, 0.5), "{velocity} {acceleration}");
}

#[test]
fn all_ink_is_on_the_paper() {
    for path in scenes() {
        let Some((scene, construction)) = solved(&path) else { continue };
        for (name, figure) in figures(&scene, &construction) {
            // A diagram of turning moments alone has no skeleton.
            let Some(ink) = figure.root.bounds() else { continue };
            let inside = ink.x0 >= 0.0 && ink.y0 >= 0.0 && ink.x1 <= figure.width && ink.y1 <= figure.height;
            assert!(inside, "{} {name}: {ink:?}", path.display());
        }
    }
}

fn vectors<'a>(group: &'a Group, out: &mut Vec<&'a Group>) {
    if group.class.starts_with("vector") {
        out.push(group);
    }
    for child in &group.children {
        if let Node::Group(child) = child {
            vectors(child, out);
        }
    }
}

/// The ink is the computation: the two ends of a vector and the scale give back the textbook's number.
#[test]
fn a_vector_s_ink_gives_its_value() {
    let (scene, construction) = problem_3_1();
    let figure = single(&scene, &construction, "velocity", Language::English).unwrap();
    let mut found = Vec::new();
    vectors(&figure.root, &mut found);
    // cm/s, worked out by hand from the coordinates of the problem (cases file, `recomputed`).
    for (quantity, value) in [("v(A)", 150.0), ("v(B)", 175.31), ("v(B/A)", 197.866), ("v(D)", 178.249)] {
        let vector = found.iter().find(|g| g.data.contains(&("quantity", quantity.to_owned()))).unwrap();
        let marks: Vec<&Mark> = vector
            .children
            .iter()
            .filter_map(|n| if let Node::Mark(m) = n { Some(m) } else { None })
            .collect();
        let (Shape::Line(tail, _), Shape::Polygon(head)) = (&marks[0].shape, &marks[1].shape) else {
            panic!("{quantity} is not an arrow")
        };
        let read = tail.distance(head[0]) * 5.0;
        assert!((read - value).abs() < 6e-4 * value, "{quantity} reads {read}, is {value}");
    }
}

#[cfg(feature = "png")]
#[test]
fn the_renderer_reads_the_svg_and_sees_the_same_text_boxes() {
    let (scene, construction) = problem_3_1();
    let figure = solution(&scene, &construction, Language::English);
    let tree = crate::render::png::parse(&svg::write(&figure)).unwrap();
    // The page is in usvg's pixels, what stands on it in millimetres.
    assert!((f64::from(tree.size().width()) - figure.width * 96.0 / 25.4).abs() < 0.01);
    let mut drawn = Vec::new();
    texts(tree.root(), &mut drawn);
    let mut measured = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            measured.push((text.content(), text.bounds().unwrap()));
        }
    });
    assert_eq!(drawn.len(), measured.len());
    for (drawn, (content, own)) in drawn.iter().zip(&measured) {
        let sides = [
            f64::from(drawn.left()) - own.x0,
            f64::from(drawn.right()) - own.x1,
            f64::from(drawn.top()) - own.y0,
            f64::from(drawn.bottom()) - own.y1,
        ];
        // Ligatures are a little narrower than their letters.
        assert!(sides.iter().all(|off| off.abs() < 0.1), "{content:?}: {own:?} is drawn in {drawn:?}");
    }
}

#[cfg(feature = "png")]
fn texts(group: &resvg::usvg::Group, out: &mut Vec<resvg::tiny_skia::Rect>) {
    for node in group.children() {
        match node {
            resvg::usvg::Node::Group(group) => texts(group, out),
            resvg::usvg::Node::Text(text) => out.push(text.flattened().abs_bounding_box()),
            _ => {}
        }
    }
}

#[test]
fn paper_grows_with_a_scale_that_is_too_large() {
    let (mut scene, _) = problem_3_1();
    scene.sheet.length_scale = Some(1.0);
    let structure = Structure::of(&scene.mechanism).unwrap();
    let plan = Plan::new(&scene.mechanism, &structure, Extent::WholeSkeleton);
    let extents = extents(&scene.mechanism, &structure, &plan).unwrap();
    let scales = scale::for_scene(&scene, extents);
    let construction = construct(&scene.mechanism, &structure, &plan, scales).unwrap().construction;
    let figure = solution(&scene, &construction, Language::English);
    assert!(figure.width > 500.0);
    assert_eq!(overlaps(&figure), vec![]);
}

/// What the graphical room cannot solve yet is drawn all the same, from places alone.
fn placed(json: &str) -> (Scene, Construction) {
    let scene = scene::read(json, "test").unwrap();
    let origin = scene.mechanism.points[0].place.exact().unwrap();
    let per_mm = 0.005;
    let mm = |p: &crate::mechanism::Point| {
        let at = p.place.exact()?;
        Some([0, 1].map(|i| (at[i].value - origin[i].value) / per_mm))
    };
    let places = scene.mechanism.points.iter().map(mm).collect();
    let space = crate::graphical::construction::Space {
        metres_per_mm: per_mm,
        places,
        axes: vec![],
        lines: vec![],
        choices: vec![],
    };
    let construction = Construction {
        space,
        diagrams: vec![],
        circle: None,
        others: vec![],
        forces: None,
        cycle: None,
        auxiliary: Vec::new(),
        steps: vec![],
        rooms: false,
        answers: vec![],
    };
    (scene, construction)
}

const SLOTTED_ARM: &str = r#"{
    "title": "Slotted arm, rod and ram", "units": { "length": "cm" },
    "fixed": { "O4": [0, 0], "O2": [0, 15] },
    "placed": { "A": [9, 21], "C": [12, 28], "D": [-8, 34] },
    "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4", "C"] }, "5": { "joins": ["C", "D"] } },
    "slides": [
        { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "C" } },
        { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 34], "angle": 0 } } ],
    "input": { "link": 2, "omega": "2 rad/s ccw" }, "find": ["v(A)"] }"#;

const GEARS: &str = r#"{
    "title": "Two wheels and a rod", "units": { "length": "cm" },
    "fixed": { "O2": [0, 0], "O3": [17.5, 0] },
    "placed": { "A": [4, 4], "B": [24, 9] },
    "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["O3"] }, "4": { "joins": ["A", "B"] } },
    "rolls": [ { "links": [2, 3], "centres": ["O2", "O3"], "radii": [7.5, 10] } ],
    "slides": [ { "pin": "B", "block": 5, "on": { "link": 1, "through": [24, 0], "angle": 90 } } ],
    "input": { "link": 2, "omega": "2 rad/s ccw" }, "find": ["v(A)"] }"#;

const CURVED_SLOT: &str = r#"{
    "title": "Pin in a curved slot", "units": { "length": "cm" },
    "fixed": { "O3": [0, 0], "O2": [14, 0] },
    "placed": { "B": [12, 4], "C": [4, 18] },
    "links": { "2": { "joins": ["O2", "B"] }, "3": { "joins": ["O3", "C"] } },
    "slides": [ { "pin": "B", "on": { "link": 3, "centre": "C", "radius": 16.1245155 } } ],
    "input": { "link": 2, "omega": "2 rad/s ccw" }, "find": ["v(B)"] }"#;

const RACK: &str = r#"{
    "title": "Wheel on a rack, and a plunger", "units": { "length": "cm" },
    "fixed": { "O": [0, 0] },
    "placed": { "A": [10, 3], "E": [16, 14], "F": [16, 24] },
    "links": { "2": { "joins": ["A"] }, "3": { "joins": ["A", "E"] }, "4": { "joins": ["E", "F"] } },
    "rolls": [ { "links": [1, 2], "line": { "link": 1, "through": [0, 0], "angle": 0 }, "centre": "A", "radius": 3 } ],
    "slides": [ { "link": 4, "on": { "link": 1, "through": [16, 0], "angle": 90 } } ],
    "input": { "link": 2, "omega": "2 rad/s ccw" }, "find": ["v(A)"] }"#;

#[test]
fn slots_wheels_and_racks_are_drawn() {
    for (name, json, class) in [
        ("arm", SLOTTED_ARM, "link slot"),
        ("gears", GEARS, "pitch-circles"),
        ("curve", CURVED_SLOT, "link slot"),
        ("rack", RACK, "pitch-circles"),
    ] {
        let (scene, construction) = placed(json);
        let figure = single(&scene, &construction, "skeleton", Language::English).unwrap();
        assert_eq!(overlaps(&figure), vec![], "{name}");
        let text = svg::write(&figure);
        assert!(text.contains(&format!("class=\"{class}\"")), "{name}");
    }
}

fn fixture(name: &str) -> (Scene, Construction) {
    let path = format!("src/sheet/tests/{name}.json");
    solved(&Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn groups<'a>(group: &'a Group, class: &str, out: &mut Vec<&'a Group>) {
    if group.class == class {
        out.push(group);
    }
    for child in &group.children {
        if let Node::Group(child) = child {
            groups(child, class, out);
        }
    }
}

fn all_of<'a>(figure: &'a Figure, class: &str) -> Vec<&'a Group> {
    let mut out = Vec::new();
    groups(&figure.root, class, &mut out);
    out
}

fn data<'a>(group: &'a Group, name: &str) -> &'a str {
    group.data.iter().find(|(n, _)| *n == name).map_or("", |(_, value)| value)
}

/// The sliding velocity turned by 90° in the sense of ω is Coriolis' direction, in the small figure as in
/// the polygon.
#[test]
fn the_rule_of_coriolis_is_shown_where_it_applies() {
    let direction = |group: &Group, nth: usize| {
        let shafts: Vec<_> = group
            .children
            .iter()
            .filter_map(|n| match n {
                Node::Mark(Mark { shape: Shape::Line(a, b), class: "shaft", .. }) => {
                    Some((*b - *a).normalize())
                }
                _ => None,
            })
            .collect();
        shafts[nth]
    };
    let (scene, construction) = fixture("trammel");
    let figure = single(&scene, &construction, "acceleration", Language::English).unwrap();
    let rules = all_of(&figure, "coriolis-rule");
    assert_eq!(rules.len(), 2);
    let velocity = single(&scene, &construction, "velocity", Language::English).unwrap();
    for rule in rules {
        let quantity = data(rule, "quantity");
        let coriolis = all_of(&figure, "vector coriolis");
        let coriolis = coriolis.iter().find(|v| data(v, "quantity") == quantity).unwrap();
        let slips = all_of(&velocity, "vector sliding");
        let slip = quantity.replace("coriolis", "slip");
        let slip = slips.iter().find(|v| data(v, "quantity") == slip).unwrap();
        assert!((direction(rule, 0) - direction(slip, 0)).hypot() < 1e-6, "{quantity}");
        assert!((direction(rule, 1) - direction(coriolis, 0)).hypot() < 1e-6, "{quantity}");
    }
    // The guide of a Scotch yoke does not turn.
    let (scene, construction) = fixture("scotch");
    let figure = single(&scene, &construction, "acceleration", Language::English).unwrap();
    assert!(all_of(&figure, "coriolis-rule").is_empty());
}

#[test]
fn no_two_places_of_a_polygon_share_a_name() {
    for path in scenes() {
        let Some((scene, construction)) = solved(&path) else { continue };
        for name in ["velocity", "acceleration"] {
            let Some(figure) = single(&scene, &construction, name, Language::English) else { continue };
            let mut places: Vec<(&str, kurbo::Point)> = Vec::new();
            for image in all_of(&figure, "image") {
                let Some(Node::Mark(Mark { shape: Shape::Circle { centre, .. }, .. })) =
                    image.children.first()
                else {
                    continue;
                };
                let name = data(image, "point");
                let other = places.iter().find(|(n, _)| *n == name);
                assert!(other.is_none_or(|(_, p)| p.distance(*centre) < 1e-5), "{} {name}", path.display());
                places.push((name, *centre));
            }
        }
    }
}

#[test]
fn guides_are_drawn_without_fixed_points_and_slots_hang_on_their_links() {
    let drawn = |name: &str, class: &str| {
        let (scene, construction) = fixture(name);
        let figure = single(&scene, &construction, "skeleton", Language::English).unwrap();
        all_of(&figure, class).len()
    };
    assert_eq!(drawn("slideinput", "guide"), 2);
    assert_eq!(drawn("oblique", "link arm"), 1);
    assert_eq!(drawn("rrpmoving", "link arm"), 1);
    assert_eq!(drawn("scotch", "link arm"), 0);
    assert_eq!(drawn("planet", "rim"), 1);
    assert_eq!(drawn("cylinder", "link slot"), 0);
}

#[test]
fn every_fixture_has_all_its_figures() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    for entry in std::fs::read_dir(root.join("src/sheet/tests")).unwrap() {
        let path = entry.unwrap().path();
        let (scene, construction) = solved(&path).unwrap_or_else(|| panic!("{}", path.display()));
        assert_eq!(figures(&scene, &construction).len(), 7, "{}", path.display());
    }
}

/// A group of higher class is drawn by the groups inside it; its links are noted once.
#[test]
fn the_image_of_a_link_is_drawn_once() {
    let wrong = on_all_scenes(|scene, construction, _| {
        let mut wrong = Vec::new();
        for name in ["velocity", "acceleration"] {
            let Some(figure) = single(scene, construction, name, Language::English) else { continue };
            let mut seen = std::collections::BTreeSet::new();
            let images = all_of(&figure, "image link-image");
            wrong.extend(
                images
                    .iter()
                    .map(|image| data(image, "link"))
                    .filter(|link| !seen.insert(*link))
                    .map(|link| format!("{name}: the image of link {link} is drawn twice")),
            );
        }
        wrong
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The two trial images of a group of higher class are not far away: the polygon itself fills its panel.
#[test]
fn a_polygon_found_by_trial_fills_its_panel() {
    for path in ["examples/pairs/higher-group.json", "src/catalogue/stephenson.json"] {
        let (_, construction) = solved(&Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
        for polygon in &construction.diagrams {
            let longest =
                polygon.vectors.iter().map(|v| libm::hypot(v.to[0] - v.from[0], v.to[1] - v.from[1]));
            let longest = longest.fold(0.0, f64::max);
            assert!(longest > 0.5 * scale::HALF_POLYGON.0, "{path}: {longest} mm");
        }
    }
}

/// The lines of text of a figure, in their order.
fn lines(figure: &Figure) -> Vec<String> {
    let mut all = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.push(text.content().replace('\u{a0}', " "));
        }
    });
    all
}

fn in_repository(path: &str) -> (Scene, Construction) {
    solved(&Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap()
}

fn says(lines: &[String], what: &str) -> bool {
    lines.join(" ").contains(what)
}

#[test]
fn steps_name_guides_and_dimensions_and_list_what_was_calculated_before() {
    let (scene, construction) = problem_3_1();
    let sheet = lines(&solution(&scene, &construction, Language::English));
    for line in [
        "Mark O2 and O4 to the scale 1 : 10.",
        "Draw the horizontal guide of D through (0; 37) cm.",
        "Mark C on link 4: O4C = 30 cm (30.0 mm), beyond O4.",
        "Produce bo beyond o: oc : ob = 1 gives c.",
        "ω2 = 10 rad/s cw (constant)",
    ] {
        assert!(says(&sheet, line), "{line}: {sheet:#?}");
    }
    // The normal parts stand in the table with their magnitudes: they were calculated before it.
    let notation = super::notation::Notation::new(&scene, Language::English.words());
    for told in super::steps::by_step(&construction, &notation) {
        let table = told.items.iter().position(|item| matches!(item, super::steps::Item::Terms(_)));
        let normal = |item: &super::steps::Item| match item {
            super::steps::Item::Sentence(text) => text.set(3.5).text.content().starts_with("An"),
            _ => false,
        };
        let (Some(table), Some(last)) = (table, told.items.iter().rposition(normal)) else { continue };
        assert!(last < table, "step {}", told.step);
    }
}

#[test]
fn a_question_asks_for_what_the_scene_does_not_say() {
    let (scene, construction) = in_repository("src/catalogue/toggle-press.json");
    let all = lines(&question(&scene, &construction, Language::English));
    let find = all.iter().position(|line| line == "Find:").unwrap();
    let asked = all[find..].join(" ");
    // The crank is given, and the slider cannot turn.
    for given in ["ω2", "ω6", "α2", "α6"] {
        assert!(!asked.contains(given), "{given}: {asked}");
    }
    assert!(asked.contains("ω3") && asked.contains("α5"), "{asked}");
    let told = all[..find].join(" ");
    assert!(told.contains("60 rpm cw (constant)"), "{told}");
    // Its places are dimensioned.
    assert!(!told.contains("(150; 100)"), "{told}");
    assert!(all.iter().any(|line| line == "150") && all.iter().any(|line| line == "100"), "{all:#?}");
    // Stated scales are given, not asked for.
    let (scene, construction) = problem_3_1();
    let all = lines(&question(&scene, &construction, Language::English));
    let find = all.iter().position(|line| line == "Find:").unwrap();
    assert!(says(&all[..find], "scales 1 : 10"), "{all:#?}");
}

/// The places of the names of a diagram, without those that its details repeat.
fn names_of(group: &Group, out: &mut std::collections::BTreeMap<String, (f64, f64)>) {
    let has = |word: &str| group.class.split(' ').any(|own| own == word);
    if has("detail") {
        return;
    }
    for node in &group.children {
        match node {
            Node::Group(child) => names_of(child, out),
            Node::Text(text) if has("name") => {
                let at = text.runs.first().map(|run| (run.at.x, run.at.y));
                out.extend(at.map(|at| (data(group, "of").to_owned(), at)));
            }
            _ => {}
        }
    }
}

#[test]
fn pictures_of_the_steps_show_few_acts_and_nothing_jumps() {
    let bad = on_all_scenes(|scene, construction, _| {
        let figure = step_by_step(scene, construction, Language::English);
        let mut bad = Vec::new();
        for class in ["velocity polygon", "acceleration polygon", "skeleton"] {
            // A construction on the skeleton is a figure of its own, and so is the skeleton with its loads.
            let alone = construction.auxiliary.is_empty() && scene.mechanism.forces.is_empty();
            if class == "skeleton" && !alone {
                continue;
            }
            let mut before: std::collections::BTreeMap<String, (f64, f64)> = Default::default();
            for diagram in all_of(&figure, class) {
                let mut now = Default::default();
                names_of(diagram, &mut now);
                // From picture to picture all names move alike: the picture as a whole has another place on the page.
                let common = now.iter().filter_map(|(name, at)| Some((name, *before.get(name)?, *at)));
                let moves: Vec<(&String, f64, f64)> =
                    common.map(|(name, was, is)| (name, is.0 - was.0, is.1 - was.1)).collect();
                for (name, x, y) in &moves {
                    if (x - moves[0].1).abs() + (y - moves[0].2).abs() > 1e-6 {
                        bad.push(format!("{class}: {name} jumps"));
                    }
                }
                before = now;
            }
        }
        let notation = super::notation::Notation::new(scene, Language::English.words());
        let most = super::compose::acts_of_pictures(construction, &notation);
        bad.extend(most.into_iter().filter(|acts| *acts > 4).map(|acts| format!("{acts} acts in a picture")));
        bad
    });
    assert!(bad.is_empty(), "{bad:#?}");
    // What is new stands before what is old.
    let (scene, construction) = problem_3_1();
    let text = svg::write(&step_by_step(&scene, &construction, Language::English));
    assert!(text.contains("class=\"vector relative\"") && text.contains("class=\"vector relative old\""));
}

#[test]
fn the_steps_of_a_scene_of_centres_show_its_figures() {
    let (scene, construction) = in_repository("examples/centres/four-bar.json");
    let figure = step_by_step(&scene, &construction, Language::English);
    assert!(!all_of(&figure, "instant-centres").is_empty());
    assert_eq!(all_of(&figure, "circle-diagram").len(), 1);
    assert_eq!(all_of(&figure, "transfer").len(), 4);
}

#[test]
fn a_centre_that_is_asked_for_is_on_the_paper() {
    let (scene, construction) = in_repository("examples/centres/four-bar.json");
    let figure = solution(&scene, &construction, Language::English);
    let centres: Vec<&str> = all_of(&figure, "centre").iter().map(|c| data(c, "centre")).collect();
    assert!(centres.contains(&"(13)"), "{centres:?}");
    let gauge = lines(&single(&scene, &construction, "transfer", Language::English).unwrap());
    // The gauge line has its pole, the arc its radius, the turned point its name.
    for name in ["(13–B)", "(B)"] {
        assert!(gauge.iter().any(|line| line == name), "{name}: {gauge:#?}");
    }
    assert!(gauge.iter().any(|line| line.ends_with("to (13)")), "{gauge:#?}");
}

#[test]
fn pins_wheels_and_cylinders_are_drawn_as_what_they_are() {
    let strokes = |group: &Group| {
        let line = |node: &Node| match node {
            Node::Mark(Mark { shape: Shape::Line(a, b), class: "", .. }) => Some((*a, *b)),
            _ => None,
        };
        group.children.iter().filter_map(line).collect::<Vec<_>>()
    };
    let bare = r#"{
        "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": "4 cm" }, "3": { "joins": ["A", "B"], "length": "9 cm" } },
        "slides": [{ "pin": "B", "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
        "near": { "B": ["12 cm", 0] },
        "input": { "link": 2, "angle": 60, "omega": "5 rad/s" },
        "find": ["v(B)"]
    }"#;
    let (scene, construction) = solved_text(bare).unwrap();
    let figure = solution(&scene, &construction, Language::English);
    let guides = all_of(&figure, "guide");
    let sides = strokes(guides[0]);
    assert_eq!(sides.len(), 2, "a bare pin runs between two sides: {sides:?}");
    let pin = all_of(&figure, "joint").into_iter().find(|joint| data(joint, "point") == "B").unwrap();
    let Some(Node::Mark(Mark { shape: Shape::Circle { centre, radius }, .. })) = pin.children.first() else {
        panic!("a pin is a circle");
    };
    let off = sides.iter().map(|(a, _)| a.y - centre.y).collect::<Vec<_>>();
    assert!(
        off[0] * off[1] < 0.0 && off.iter().all(|y| (radius..&(2.0 * radius)).contains(&&y.abs())),
        "{off:?}"
    );

    let (scene, construction) = in_repository("src/catalogue/geneva.json");
    let figure = solution(&scene, &construction, Language::English);
    let wheel = all_of(&figure, "link slot");
    let Some(Node::Mark(Mark { shape: Shape::Polygon(outline), class: "wheel", .. })) =
        wheel[0].children.first()
    else {
        panic!("the wheel of a Geneva drive is an outline");
    };
    // Four slots at right angles: turned by a quarter the outline is itself.
    let centre = outline.iter().fold(kurbo::Vec2::ZERO, |sum, p| sum + p.to_vec2()) / outline.len() as f64;
    for (i, p) in outline.iter().enumerate() {
        let d = p.to_vec2() - centre;
        let turned = kurbo::Vec2::new(d.y, -d.x);
        let other = outline[(i + outline.len() / 4) % outline.len()].to_vec2() - centre;
        assert!((turned - other).hypot() < 1e-6, "{i}: {turned:?} {other:?}");
    }

    let (scene, construction) = in_repository("src/catalogue/oscillating-cylinder.json");
    let text = svg::write(&solution(&scene, &construction, Language::English));
    assert!(text.contains("class=\"piston\""));
}

#[test]
fn a_crowded_spot_has_its_detail_at_a_true_multiple() {
    let (scene, construction) = problem_3_1();
    let figure = single(&scene, &construction, "acceleration", Language::English).unwrap();
    let details = all_of(&figure, "detail");
    assert_eq!(details.len(), 1, "c′ and d′1 stand 1.1 mm apart");
    let multiple: f64 = data(details[0], "multiple").parse().unwrap();
    let points: Vec<kurbo::Point> = details[0]
        .children
        .iter()
        .filter_map(|node| match node {
            Node::Mark(Mark { shape: Shape::Circle { centre, .. }, class: "detail-point", .. }) => {
                Some(*centre)
            }
            _ => None,
        })
        .collect();
    let polygon = construction.diagram(DiagramKind::Acceleration).unwrap();
    let foot = polygon
        .vectors
        .iter()
        .find(|v| {
            v.kind == crate::graphical::construction::VectorKind::Normal
                && libm::hypot(v.to[0] - v.from[0], v.to[1] - v.from[1]) < 2.0
        })
        .unwrap();
    let apart = libm::hypot(foot.to[0] - foot.from[0], foot.to[1] - foot.from[1]);
    assert!((points[0].distance(points[1]) - multiple * apart).abs() < 1e-9, "{points:?} {apart}");
}

#[test]
fn the_catalogue_has_its_titles_in_every_language() {
    for kind in crate::catalogue::KINDS {
        let scene = scene::read(kind.scene, kind.name).unwrap();
        for tag in ["en", "ar", "fa"] {
            let own = scene.title.by_language.iter().find(|(own, _)| own == tag);
            assert!(own.is_some_and(|(_, title)| !title.is_empty()), "{} in {tag}", kind.name);
        }
    }
}

/// What is calculated of a vector is laid off in the same step, and what is laid off from the pole is not read after that.
#[test]
fn what_is_calculated_is_laid_off_and_not_read() {
    use crate::graphical::construction::{Act, Calculation, Label};
    let wrong = on_all_scenes(|_, construction, name| {
        let mut all = Vec::new();
        for step in &construction.steps {
            let Some(diagram) = construction.diagram(step.diagram) else { continue };
            let vector = |index: usize| &diagram.vectors[index];
            for (i, act) in step.acts.iter().enumerate() {
                let later = &step.acts[i..];
                let laid_off = |quantity| {
                    later.iter().any(|act| match act {
                        Act::LayOffVector { vector: index, .. } => vector(*index).quantity == quantity,
                        _ => false,
                    })
                };
                match act {
                    Act::Calculate(
                        Calculation::Speed { quantity, .. }
                        | Calculation::Normal { quantity, .. }
                        | Calculation::Tangential { quantity, .. }
                        | Calculation::Coriolis { quantity, .. }
                        | Calculation::SlipNormal { quantity, .. },
                    ) if !laid_off(*quantity) => all.push(format!("{name}: {quantity:?} is not laid off")),
                    Act::LayOffVector { vector: index, .. } if vector(*index).tail == Label::Pole => {
                        let own = vector(*index);
                        let same = |other: usize| {
                            let other = vector(other);
                            (other.quantity, other.tail, other.head) == (own.quantity, own.tail, own.head)
                        };
                        let read = |act: &Act| matches!(act, Act::ReadVector { vector, .. } if same(*vector));
                        if later.iter().any(read) {
                            all.push(format!("{name}: {:?} is laid off and read", own.quantity));
                        }
                    }
                    _ => {}
                }
            }
        }
        all
    });
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Two points under one pin have two names, and what one has against the other is said and drawn.
#[test]
fn a_transfer_by_centres_derives_what_is_asked() {
    let (scene, construction) = in_repository("examples/centres/whitworth.json");
    let figure = solution(&scene, &construction, Language::English);
    let sheet = lines(&figure);
    for line in ["ω2 = 2π × 30 / 60 = 3.142 rad/s ccw", "VA4 = ω4 (14–A)", "As vectors VA2A4 = VA2 − VA4"]
    {
        assert!(says(&sheet, line), "{line}: {sheet:#?}");
    }
    let transfer = all_of(&figure, "transfer")[0];
    let mut arrows = Vec::new();
    groups(transfer, "velocity vector", &mut arrows);
    let mut of: Vec<&str> = arrows.iter().map(|arrow| data(arrow, "of")).collect();
    of.sort_unstable();
    assert_eq!(of, ["A", "A4", "C", "slip(A/4)"]);
}

/// A line that leads to a point of the sheet ends there, and not at an arrow in empty paper.
#[test]
fn lines_from_link_to_link_end_at_their_points() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/s000-ch3b-1.json");
    let text = std::fs::read_to_string(path).unwrap();
    for paper in ["A4", "A3 landscape"] {
        let mut value: serde_json::Value = serde_json::from_str(&text).unwrap();
        value["sheet"]["paper"] = paper.into();
        let (scene, construction) = solved_text(&value.to_string()).unwrap();
        let figure = solution(&scene, &construction, Language::English);
        let lines: Vec<&Group> =
            ["parallel", "to-pole"].into_iter().flat_map(|class| all_of(&figure, class)).collect();
        assert!(lines.len() >= 4, "{paper}");
        for line in lines {
            assert_eq!(line.children.len(), 1, "{paper}: {} ends in a head", line.class);
        }
    }
}

/// Every vector that is laid off says which way, and no step goes in a circle.
#[test]
fn the_way_of_what_is_laid_off_is_said() {
    let sheet = |path: &str| {
        let (scene, construction) = in_repository(path);
        lines(&solution(&scene, &construction, Language::English)).join(" ")
    };
    let trammel = sheet("examples/s000-ch4-4.json");
    for line in ["∥ guide of A, ∠ 90°", "∥ guide of A, against VA"] {
        assert!(trammel.contains(line), "{line}: {trammel}");
    }
    let speed = sheet("examples/s000-ch4-8-b.json");
    assert!(speed.contains("ω4 = VB / O4B") && speed.contains("Lay off VB = ob"), "{speed}");
    assert!(!speed.contains("Read VB") && !speed.contains("VB = ω4"), "{speed}");
}

/// A polygon whose names crowd takes the room that its page has anyway.
#[test]
fn a_crowded_polygon_takes_the_room_of_its_pages() {
    for (path, per_mm) in [("examples/s000-ch4-7.json", 0.1), ("src/catalogue/coupler-slot.json", 0.5)] {
        let (scene, construction) = in_repository(path);
        let scale = construction.diagram(DiagramKind::Acceleration).unwrap().si_per_mm;
        assert!((scale / per_mm - 1.0).abs() < 1e-12, "{path}: {scale}");
        let pages = solution(&scene, &construction, Language::English).height / 297.0;
        assert!((pages - 3.0).abs() < 1e-9, "{path}: {pages} pages");
    }
}

/// Vectors that differ by a part which is drawn as a point are one stroke with one name.
#[test]
fn strokes_that_are_one_to_the_eye_are_named_once() {
    let (scene, construction) = in_repository("src/catalogue/coupler-slot.json");
    let figure = single(&scene, &construction, "acceleration", Language::English).unwrap();
    let names = lines(&figure);
    assert!(names.iter().any(|name| name == "AD ≈ AtD"), "{names:?}");
    assert!(!names.iter().any(|name| name == "AtD" || name == "AD"), "{names:?}");
}

#[test]
fn a_force_that_is_zero_but_for_rounding_has_no_line_and_the_sleeve_has_the_load_of_all_halves() {
    let (scene, construction) = in_repository("examples/forces/s000-ch5-3a.json");
    let figure = solution(&scene, &construction, Language::English);
    // Bell crank: the spring of both halves is 2 · 25/9.81 · (10π)² · 0.1 · 120/60 N.
    let omega = 10.0 * std::f64::consts::PI;
    let whole = 2.0 * 25.0 / 9.81 * omega * omega * 0.1 * 2.0;
    assert_eq!(format!("{whole:.0}"), "1006");
    let told = lines(&figure).join(" ");
    assert!(told.contains("1006 N") && told.contains("Fk/2"), "{told}");
    assert!(!told.contains("× 10−"), "{told}");
    let ink = figure.root.bounds().unwrap();
    assert!(ink.x0 >= 0.0 && ink.y0 >= 0.0 && ink.x1 <= figure.width && ink.y1 <= figure.height, "{ink:?}");
    assert!(figure.height < 2.1 * 297.0, "{}", figure.height);
}

/// What is asked for in another unit than the drawing's has the line that leads to it.
#[test]
fn a_rate_in_another_unit_has_its_line() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 120 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }], "near": { "B": [130, 0] },
        "input": { "link": 2, "angle": 60, "omega": "300 rpm ccw" },
        "find": [{ "name": "omega(3)", "unit": "rpm" }, { "name": "omega(3/2)", "unit": "deg/s" }] }"#;
    let (scene, construction) = solved_text(text).unwrap();
    let sheet = lines(&solution(&scene, &construction, Language::English));
    let omega = 10.0 * std::f64::consts::PI;
    let height = 40.0 * libm::sin(60_f64.to_radians());
    let rod = omega * 20.0 / (120.0 * 120.0 - height * height).sqrt();
    let told = sheet.join(" ");
    let asked = format!("× 60 / 2π = {:.1} rpm cw", rod * 30.0 / std::f64::consts::PI);
    assert!(told.contains("ω3 = 5.46") && told.contains(&asked), "{asked}: {sheet:#?}");
    // Read to four figures, and told in degrees to a unit of the fourth.
    let degrees = (rod + omega).to_degrees();
    let printed = told.split("× 180 / π = −").nth(1).and_then(|rest| rest.split_once(" °/s"));
    let printed: f64 = printed.unwrap().0.parse().unwrap();
    assert!((printed - degrees).abs() < 1.0, "{printed} for {degrees}: {sheet:#?}");
}

/// A swivelling guide of a link with one joint lies along its rod in every position: its stroke and the rod's go through the
/// fixed joint and through the pin of the crank, which stands where its circle has it.
#[test]
fn a_swivelling_guide_follows_its_rod_in_other_positions() {
    let angles = [20.0_f64, 110.0, 250.0];
    for (path, place) in [
        ("src/catalogue/oscillating-cylinder.json", [180.0, 0.0]),
        ("src/sheet/tests/cylinder.json", [150.0, 20.0]),
    ] {
        let mut value: serde_json::Value =
            serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        value["sheet"]["positions"] = angles.to_vec().into();
        let (scene, construction) = solved_text(&value.to_string()).unwrap();
        let figure = single(&scene, &construction, "skeleton", Language::English).unwrap();
        let others = all_of(&figure, "other-position");
        assert_eq!(others.len(), angles.len(), "{path}");
        for (other, angle) in others.into_iter().zip(angles) {
            let strokes = |link: &str| -> Vec<(kurbo::Point, kurbo::Point)> {
                let of_link = |node: &Node| match node {
                    Node::Group(group) if group.data.contains(&("link", link.to_owned())) => {
                        group.children.iter().find_map(|own| match own {
                            Node::Mark(Mark { shape: Shape::Line(from, to), .. }) => Some((*from, *to)),
                            _ => None,
                        })
                    }
                    _ => None,
                };
                other.children.iter().filter_map(of_link).collect()
            };
            let [(pivot, pin)] = strokes("2")[..] else { panic!("{path}: no crank at {angle}") };
            let turned = libm::atan2(pivot.y - pin.y, pin.x - pivot.x).to_degrees();
            assert!(libm::remainder(turned - angle, 360.0).abs() < 1e-6, "{path}: {turned} for {angle}");
            let per_mm = construction.space.metres_per_mm;
            let joint = pivot + kurbo::Vec2::new(place[0], -place[1]) * (1e-3 / per_mm);
            let along = (joint - pin).normalize();
            for link in ["3", "4"] {
                let own = strokes(link);
                assert!(!own.is_empty(), "{path}: link {link} is missing at {angle}");
                for end in own.iter().flat_map(|(from, to)| [from, to]) {
                    let off = (*end - joint).cross(along).abs();
                    assert!(off < 1e-6, "{path}: link {link} at {angle} ends {off} mm beside its line");
                }
            }
        }
    }
}

/// Every arrow of the small polygon of two masses that has room for it says which acceleration it is.
#[test]
fn the_accelerations_of_two_masses_are_named() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [200, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 180 },
            "4": { "joins": ["O4", "B"], "length": 120 } }, "near": { "B": [170, 115] },
        "input": { "link": 2, "angle": 60, "omega": "100 rad/s ccw" },
        "masses": { "3": { "mass": 2, "inertia": 0.012, "at": [70, 0] } },
        "find": [{ "name": "Fin(3)", "method": "two-masses", "first": "A" }] }"#;
    let (scene, construction) = solved_text(text).unwrap();
    let figure = single(&scene, &construction, "equivalent(3,A)", Language::English).unwrap();
    let lines = lines(&figure);
    for name in ["AA", "AG3", "AC"] {
        assert!(says(&lines, name), "{name}: {lines:?}");
    }
}
