//! Sheets of forces as an examiner reads them: governors are solved on them, friction is told before it is used, arms close
//! with their scale, what is asked is found in a step.

#![allow(clippy::unwrap_used, reason = "a test")]

use linkgram::drawing::{self, Kind, Wish};
use linkgram::sheet::figure::{Figure, Group, Node};

use crate::common;

/// The lines of a figure, in the order in which they are set.
fn lines(figure: &Figure) -> Vec<(String, String)> {
    fn walk(group: &Group, all: &mut Vec<(String, String)>) {
        for child in &group.children {
            match child {
                Node::Group(group) => walk(group, all),
                Node::Text(text) => {
                    let words: Vec<String> = text.content().split_whitespace().map(str::to_owned).collect();
                    all.push((text.class.to_owned(), words.join(" ")));
                }
                Node::Mark(_) => {}
            }
        }
    }
    let mut all = Vec::new();
    walk(&figure.root, &mut all);
    all
}

fn text_of(figure: &Figure) -> String {
    lines(figure).into_iter().map(|(_, line)| line).collect::<Vec<_>>().join("\n")
}

/// How many groups have this class.
fn count(figure: &Figure, class: &str) -> usize {
    fn walk(group: &Group, class: &str) -> usize {
        let own = usize::from(group.class == class);
        let within = |child: &Node| match child {
            Node::Group(group) => walk(group, class),
            _ => 0,
        };
        own + group.children.iter().map(within).sum::<usize>()
    }
    walk(&figure.root, class)
}

fn sheet(text: &str, kind: Kind) -> Figure {
    let scene = linkgram::scene::read(text, "scene.json").unwrap_or_else(|error| panic!("{error}"));
    let wish = Wish { kind, ..Wish::default() };
    drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)))
}

fn file(name: &str) -> String {
    std::fs::read_to_string(common::root().join(name)).unwrap()
}

/// The numbers before a unit, wherever it stands.
fn before(text: &str, unit: &str) -> Vec<f64> {
    let mut all = Vec::new();
    for (at, _) in text.match_indices(unit) {
        let number: String =
            text[..at].chars().rev().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
        all.extend(number.chars().rev().collect::<String>().parse::<f64>());
    }
    all
}

/// The speed of a Porter governor whose arms are alike and hang on the axis, with this force on the whole sleeve, rad/s: how
/// far the ball is out does not count, only how far it hangs down.
fn porter(ball: f64, sleeve: f64, down: f64) -> f64 {
    libm::sqrt((ball * 9.81 + sleeve) / (ball * down))
}

#[test]
fn a_governor_is_solved_on_its_sheet() {
    for name in [
        "examples/forces/s000-ch5-3a.json",
        "examples/forces/s000-ch5-3b.json",
        "examples/forces/s000-ch5-5a.json",
        "src/catalogue/governor-porter.json",
        "src/catalogue/governor-hartnell.json",
    ] {
        let figure = sheet(&file(name), Kind::Solution);
        let text = text_of(&figure);
        assert!(!text.contains("Velocity diagram"), "{name}: a mechanism at rest has none");
        assert!(!text.contains("Acceleration diagram"), "{name}: a mechanism at rest has none");
        assert!(count(&figure, "free-body") >= 2, "{name}: sleeve and arm are cut free");
        assert!(text.contains("Moments of link") && text.contains("Measured:"), "{name}");
        assert!(text.contains("rpm"), "{name}: a speed in turns a minute");
        let given: Vec<String> =
            lines(&figure).into_iter().filter(|(class, _)| class == "given").map(|(_, line)| line).collect();
        assert!(given.iter().all(|line| !line.contains('?')), "{name}: {given:?}");
    }
}

#[test]
fn the_speeds_of_a_governor_are_those_of_the_closed_form() {
    let text = text_of(&sheet(&file("src/catalogue/governor-porter.json"), Kind::Solution));
    let told = before(&text, " rpm");
    for sense in [20.0, -20.0] {
        let rpm = porter(4.0, 24.0 * 9.81 + sense, 0.2) * 30.0 / std::f64::consts::PI;
        assert!(told.iter().any(|told| (told - rpm).abs() < 0.6), "{rpm}: {told:?}");
    }
    // M ω² r = 25/9.81 (2π 300/60)² 0.1, and by moments twice that on the roller.
    let text = text_of(&sheet(&file("examples/forces/s000-ch5-3a.json"), Kind::Solution));
    let force = 25.0 / 9.81 * libm::pow(std::f64::consts::PI * 10.0, 2.0) * 0.1;
    let newtons = before(&text, " N");
    for wanted in [force, 2.0 * force, 4.0 * force] {
        assert!(newtons.iter().any(|told| (told - wanted).abs() <= 2e-3 * wanted), "{wanted}: {newtons:?}");
    }
    assert!(text.contains("2π × 300 / 60"), "{text}");
}

/// The part that counts in a half is named as such wherever it is told.
#[test]
fn what_halves_share_has_one_name() {
    let figure = sheet(&file("examples/forces/s000-ch5-3a.json"), Kind::Solution);
    let heads: Vec<String> =
        lines(&figure).into_iter().map(|(_, line)| line).filter(|l| l.contains("Fk")).collect();
    assert!(heads.iter().any(|line| line.trim() == "Fk/2"), "{heads:?}");
}

#[test]
fn friction_is_told_before_the_force_that_it_turns() {
    let text = text_of(&sheet(&file("examples/forces/friction-slider-crank.json"), Kind::Solution));
    let steps = text.rfind("Velocity of link 3").unwrap();
    let told = |what: &str| text[steps..].find(what).unwrap_or_else(|| panic!("{what}: {text}"));
    assert!(told("Friction at B") < told("Forces on link 4"));
    assert!(told("Friction at A") < told("Forces on link 3"));
    assert!(!text.contains("Passes"), "{text}");
    // The pin and the guide of B are two.
    assert!(told("Friction in the horizontal guide of B") < told("Forces on link 4"));
    assert_eq!(text.matches("Friction at B").count(), text.matches("Friction at A").count(), "{text}");
    // r sin arctan f, of three pins.
    for radius in [12.0, 18.0, 20.0] {
        let circle = radius * libm::sin(libm::atan(0.08));
        assert!(before(&text, " mm").iter().any(|told| (told - circle).abs() <= 5e-3 * circle), "{circle}");
    }
    // The torque has its line: force by arm.
    assert!(text.contains("Moments of link 2 about the point of contact at O2"), "{text}");
    assert!(before(&text, " N·m").iter().any(|told| (told - 88.6157).abs() < 0.06), "{text}");
}

/// What is measured on paper, by the scale of the skeleton, is what it is said to be, within its last digit.
#[test]
fn measured_arms_close_with_the_scale() {
    let mut seen = 0;
    for entry in std::fs::read_dir(common::root().join("examples/forces")).unwrap() {
        let path = entry.unwrap().path();
        for paper in [None, Some("A3 landscape")] {
            let mut scene: serde_json::Value =
                serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
            if let Some(paper) = paper {
                scene["sheet"]["paper"] = serde_json::json!(paper);
            }
            let text = text_of(&sheet(&scene.to_string(), Kind::Solution)).replace('\n', " ");
            let scale = text.match_indices("scale ").find_map(|(at, _)| {
                let (one, other) = text[at + 6..].split_once(" : ")?;
                let other: String = other.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
                Some(other.parse::<f64>().ok()? / one.parse::<f64>().ok()?)
            });
            for (at, sign) in text.match_indices(" mm ≙ ") {
                let Some(scale) = scale else { panic!("{}: no scale", path.display()) };
                let mm = before(&text[..at + 3], " mm").pop().unwrap();
                let told: String =
                    text[at + sign.len()..].chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect();
                let unit = text[at + sign.len() + told.len()..].split_whitespace().next().unwrap();
                let unit = match unit.trim_end_matches([',', '.', ';']) {
                    "mm" => 1.0,
                    "cm" => 10.0,
                    "m" => 1000.0,
                    other => panic!("{}: {other}", path.display()),
                };
                let last = told.split_once('.').map_or(1.0, |(_, d)| libm::pow(10.0, -(d.len() as f64)));
                let value: f64 = told.parse().unwrap();
                let off = (mm * scale / unit - value).abs();
                assert!(off <= last * 1.000_001, "{}: {mm} mm × {scale} is not {told}", path.display());
                seen += 1;
            }
        }
    }
    assert!(seen > 30, "{seen}");
}

#[test]
fn an_asked_arm_is_measured_in_a_figure() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 200 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ], "near": { "B": [230, 0] },
        "input": { "link": 2, "angle": 40, "omega": "1200 rpm ccw" }, "gravity": {},
        "masses": { "3": { "mass": 1.8, "inertia": 0.012, "at": [70, 0] }, "4": { "mass": 1.2 } },
        "loads": [ { "name": "P", "on": 4, "force": 4500, "direction": 180 } ],
        "find": ["T(2)", "arm(FS,O2)", "moment(F(2,3),B)"] }"#;
    let figure = sheet(scene, Kind::Solution);
    let text = text_of(&figure).replace('\n', " ");
    assert!(text.contains("Arms of forces, scale"), "{text}");
    assert!(text.contains("Measured: aB(F23)"), "{text}");
    // That of the shaking force is the e of its line, which is told though one inertia force passes through O2.
    assert!(text.contains("aO2(FS) = e ="), "{text}");
    assert!(text.contains("Its line by moments about O2"), "{text}");
}

/// A load that is sought on the driven link follows from its moments: no trial.
#[test]
fn moments_of_the_driven_link_give_what_is_sought_on_it() {
    let text = text_of(&sheet(&file("examples/forces/s000-ch5-2.json"), Kind::Solution)).replace('\n', " ");
    assert!(text.contains("Moments of link 2 about O2: FA ="), "{text}");
    assert!(!text.contains("In proportion"), "{text}");
}

#[test]
fn captions_of_several_figures_are_lettered_on() {
    let mut scene: serde_json::Value =
        serde_json::from_str(&file("examples/forces/s000-ch5-1.json")).unwrap();
    scene["sheet"]["figures"] = serde_json::json!(["velocity", "polygon(4)", "skeleton", "shaking"]);
    let figure = sheet(&scene.to_string(), Kind::Solution);
    let letters: Vec<String> = lines(&figure)
        .into_iter()
        .filter(|(class, line)| class == "caption" && line.starts_with('('))
        .map(|(_, line)| line.chars().take(3).collect())
        .collect();
    let wanted: Vec<String> =
        "abcdefgh".chars().take(letters.len()).map(|letter| format!("({letter})")).collect();
    assert!(letters.len() >= 4, "{letters:?}");
    assert_eq!(letters, wanted);
}

#[test]
fn what_is_given_is_given_as_one_says_it() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "C"], "length": 300 } }, "input": { "link": 2, "angle": 25 },
        "gravity": {}, "masses": { "2": { "mass": 6, "at": "C" } }, "find": ["T(2)"] }"#;
    let given = text_of(&sheet(scene, Kind::Question));
    assert!(given.contains("9.81 m/s²") && !given.contains("9810"), "{given}");
    assert!(!given.contains("ω2 = 0"), "{given}");
}

/// Every figure of the solution stands in the steps too, each once.
#[test]
fn steps_have_the_figures_of_the_solution() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 20], "angle": 0 }, "f": 0.2 } ],
        "near": { "B": [180, 20] }, "pins": { "A": { "radius": 15, "f": 0.1 } },
        "input": { "link": 2, "angle": 110, "omega": "3 rad/s ccw" }, "gravity": {},
        "masses": { "3": { "mass": 4, "at": [75, 0] } },
        "loads": [ { "name": "P", "on": 4, "force": 600, "direction": "against" } ],
        "find": ["T(2)", "F(1,4)", "F(3,4)"] }"#;
    for text in
        [scene.to_owned(), file("examples/forces/s000-ch5-1.json"), file("examples/forces/s000-ch5-3a.json")]
    {
        let captions = |kind: Kind| -> Vec<String> {
            let figure = sheet(&text, kind);
            let all = lines(&figure)
                .into_iter()
                .filter(|(class, line)| class == "caption" && line.starts_with('('));
            // The scale may be another one, and so may the place of a letter.
            let mut all: Vec<String> = all
                .map(|(_, line)| line.split_once(") ").unwrap().1.split(',').next().unwrap().to_owned())
                .filter(|line| line.starts_with("F") || line.starts_with("P"))
                .collect();
            all.sort();
            all
        };
        let (solution, steps) = (captions(Kind::Solution), captions(Kind::Steps));
        assert!(solution.len() > 2, "{solution:?}");
        assert_eq!(solution, steps);
    }
}

/// A force of a hundredth of another is an arrow in a detail.
#[test]
fn a_small_side_of_a_force_polygon_has_a_detail() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 240 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ], "near": { "B": [290, 0] },
        "input": { "link": 2, "angle": 20 }, "gravity": {}, "masses": { "4": { "mass": 4 } },
        "loads": [ { "name": "P", "on": 4, "force": 4000, "direction": 180 } ], "find": ["T(2)", "F(1,4)"] }"#;
    let figure = sheet(scene, Kind::Solution);
    assert!(count(&figure, "detail") >= 1);
    assert!(text_of(&figure).contains("Detail, "), "{}", text_of(&figure));
}

/// A polygon of forces fills its place, by a scale of its own: 85 mm at the next finer of 1, 2, 2.5, 5, or hardly less.
#[test]
fn a_force_polygon_fills_its_place() {
    let engine = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "engine").unwrap();
    let scenes = [
        file("examples/forces/gas-engine.json"),
        engine.scene.to_owned(),
        file("examples/forces/s000-ch5-16.json"),
    ];
    let mut polygons = 0;
    for scene in &scenes {
        let figure = sheet(scene, Kind::Solution);
        for group in crate::legibility::within(&figure.root) {
            if !crate::legibility::has(group, "force") || !crate::legibility::has(group, "polygon") {
                continue;
            }
            polygons += 1;
            let vectors = group.children.iter().filter_map(|node| match node {
                Node::Group(own) if crate::legibility::has(own, "vector") => own.bounds(),
                _ => None,
            });
            let size = vectors.reduce(|all, own| all.union(own)).unwrap();
            let size = size.width().max(size.height());
            assert!(size >= 85.0 / 2.5 / 1.3, "{size} mm: {scene}");
        }
    }
    assert!(polygons >= 8, "{polygons}");
}

#[test]
fn what_the_frame_feels_is_a_sum_with_a_line() {
    let crank = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 130 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }], "near": { "B": [120, 0] },
        "input": { "link": 2, "angle": 90 }, "loads": [{ "name": "P", "on": 4, "force": 120, "direction": 180 }],
        "find": ["F(frame)", "T(2)", "moment(F(1,4),B)"] }"#;
    let figure = sheet(crank, Kind::Solution);
    let text = text_of(&figure);
    assert!(text.contains("Force on the frame"), "{text}");
    // F1 is what 2 and 4 exert on the frame: the load of 120 N goes through, on its own line 50 N·0.12/120 = 0.
    let step = text.split("Force on the frame").last().unwrap();
    let flat: String = step.split_whitespace().collect();
    assert!(flat.contains("F1=F21+F41") || flat.contains("F_1=F_21+F_41"), "{step}");
    assert!(flat.contains("120N"), "{step}");
    // T2 is 120 N × 50 mm: F41 of 50 N at 120 mm turns as much.
    assert!(step.contains("Its line by moments about"), "{step}");
    // F14 acts at B: an arm of nothing has a line as well.
    assert!(text.contains("passes through"), "{text}");
}

#[test]
fn a_shaking_force_of_one_force_and_a_couple_has_its_line_told() {
    // A pinion of radius 60 mm and a rack of 8 kg: F = 8 kg × 0.06 m × 30/s² = 14.4 N at 60 mm, T = 0.02 × 30 = 0.6 N·m;
    // e = (14.4 × 60 + 600)/14.4 = 101.67 mm.
    let rack = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] }, "placed": { "R": [0, -60] },
        "links": { "2": { "joins": ["O2"] }, "3": { "joins": ["R"] } },
        "slides": [{ "link": 3, "on": { "link": 1, "through": [0, -60], "angle": 0 } }],
        "rolls": [{ "links": [3, 2], "line": { "link": 3, "through": "R" }, "centre": "O2", "radius": 60 }],
        "input": { "link": 2, "angle": 0, "omega": 5, "alpha": 30 },
        "masses": { "2": { "inertia": 0.02 }, "3": { "mass": 8 } }, "find": ["T(2)", "FS"] }"#;
    let text = text_of(&sheet(rack, Kind::Solution));
    assert!(text.contains("Its line by moments about") && text.contains("102 mm"), "{text}");
}

/// The drawing of one figure of a scene.
fn one(text: &str, name: &str) -> Figure {
    let scene = linkgram::scene::read(text, "scene.json").unwrap_or_else(|error| panic!("{error}"));
    let wish = Wish { figures: vec![name.to_owned()], ..Wish::default() };
    drawing::figure(&scene, &wish).unwrap_or_else(|error| panic!("{}", error.told(&scene)))
}

/// All texts of a figure of one class, each with its place.
fn texts(figure: &Figure, class: &str) -> Vec<(String, kurbo::Point)> {
    let within = crate::legibility::within(&figure.root);
    let nodes = within.iter().flat_map(|group| &group.children);
    let of_class = nodes.filter_map(|node| match node {
        Node::Text(text) if text.class == class => Some((text.content(), text.bounds()?.center())),
        _ => None,
    });
    of_class.collect()
}

/// Forces that stand in one line, one beyond the other: each name is nearer to its own arrow than to any other.
#[test]
fn names_of_arrows_in_one_line_stand_beside_their_own() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 90 } } ],
        "near": { "B": [0, 240] }, "input": { "link": 2, "angle": 250, "omega": "12 rad/s" },
        "gravity": {}, "masses": { "4": { "mass": 3 } },
        "loads": [ { "name": "P", "on": 4, "at": "B", "force": [0, -80] },
                   { "name": "Q", "on": 4, "at": "B", "force": [0, -40] } ], "find": ["T(2)", "F(1,4)"] }"#;
    let figure = one(scene, "body(4)");
    let mut arrows: Vec<(String, kurbo::Line)> = Vec::new();
    for group in crate::legibility::within(&figure.root) {
        if !(crate::legibility::has(group, "force") && crate::legibility::has(group, "applied")) {
            continue;
        }
        let name = crate::legibility::data(group, "quantity").unwrap().to_owned();
        let shaft = group.children.iter().find_map(|node| match node {
            Node::Mark(mark) => match mark.shape {
                linkgram::sheet::figure::Shape::Line(from, to) => Some(kurbo::Line::new(from, to)),
                _ => None,
            },
            _ => None,
        });
        arrows.push((name, shaft.unwrap()));
    }
    assert!(arrows.len() >= 4, "{arrows:?}");
    let distance = |line: &kurbo::Line, at: kurbo::Point| {
        let along = line.p1 - line.p0;
        let part = ((at - line.p0).dot(along) / along.hypot2()).clamp(0.0, 1.0);
        (line.p0 + along * part).distance(at)
    };
    let mut held = 0;
    for (text, at) in texts(&figure, "label force-name") {
        let quantity = match text.trim() {
            "P" => "load(P)",
            "Q" => "load(Q)",
            "W4" => "W(4)",
            _ => continue,
        };
        let (own, others): (Vec<_>, Vec<_>) = arrows.iter().partition(|(name, _)| name == quantity);
        let [(_, own)] = own[..] else { panic!("{quantity}: {arrows:?}") };
        for (other, shaft) in others {
            assert!(distance(own, at) < distance(shaft, at), "{text} stands beside {other}");
            held += 1;
        }
    }
    assert!(held >= 6, "{held} names");
}

/// On the body that carries a guide the pin that slides there is named, to which the arm is read; so is a contact.
#[test]
fn places_where_forces_act_are_named_on_both_bodies() {
    let shaper = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -120] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "4": { "joins": ["O4", "C"], "length": 260 } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "C" } } ],
        "near": { "C": [60, 130] }, "input": { "link": 2, "angle": 30 },
        "loads": [ { "name": "Q", "on": 4, "at": "C", "force": [300, 0] } ], "find": ["T(2)", "F(3,4)"] }"#;
    let names = |figure: &Figure| -> Vec<String> {
        texts(figure, "label point-name").into_iter().map(|(text, _)| text.trim().to_owned()).collect()
    };
    let shown = names(&one(shaper, "body(4)"));
    assert!(shown.iter().any(|name| name == "A"), "{shown:?}");
}

/// On larger paper a polygon of forces is larger, as all diagrams are.
#[test]
fn a_force_polygon_grows_with_the_paper() {
    let scene = file("examples/forces/s000-ch5-16.json");
    let mut sizes = Vec::new();
    for paper in ["A4", "A2"] {
        let mut text: serde_json::Value = serde_json::from_str(&scene).unwrap();
        text["sheet"]["paper"] = paper.into();
        let figure = sheet(&text.to_string(), Kind::Solution);
        let groups = crate::legibility::within(&figure.root);
        let polygons = groups.iter().filter(|group| {
            crate::legibility::has(group, "force") && crate::legibility::has(group, "polygon")
        });
        let size = |group: &&&Group| group.bounds().map(|own| own.width().max(own.height()));
        sizes.push(polygons.filter_map(|group| size(&group)).fold(0.0, f64::max));
    }
    assert!(sizes[1] > 1.4 * sizes[0], "{sizes:?}");
}
