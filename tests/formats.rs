//! The same figure in its formats: what one says the others say, and no byte depends on the run.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::sheets;

use std::collections::BTreeSet;

use linkgram::plan::Extent;
use linkgram::render::theme::Theme;
use linkgram::render::{Format, json, svg, tex};
use linkgram::sheet::{self, Figure, Language};
use roxmltree::{Document, Node};
use serde_json::Value;

fn figure(name: &str, single: Option<&str>) -> Figure {
    let path = sheets::root().join("examples").join(format!("{name}.json"));
    let scene = linkgram::scene::read(&std::fs::read_to_string(path).unwrap(), name).unwrap();
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let construction = &solved.solution.construction;
    match single {
        None => sheet::solution(&scene, construction, Language::English),
        Some(single) => sheet::single(&scene, construction, single, Language::English).unwrap(),
    }
}

fn has(node: Node<'_, '_>, class: &str) -> bool {
    node.attribute("class").is_some_and(|classes| classes.split(' ').any(|c| c == class))
}

/// The first two numbers of an element's path or circle.
fn start(node: Node<'_, '_>) -> [f64; 2] {
    if let (Some(x), Some(y)) = (node.attribute("cx"), node.attribute("cy")) {
        return [x, y].map(|text| text.parse().unwrap());
    }
    let mut numbers = node.attribute("d").unwrap()[1..].split([' ', 'L']).map(|text| text.parse().unwrap());
    [numbers.next().unwrap(), numbers.next().unwrap()]
}

fn pair(value: &Value) -> [f64; 2] {
    [0, 1].map(|i| value[i].as_f64().unwrap())
}

fn list<'a>(value: &'a Value, key: &str) -> &'a [Value] {
    value[key].as_array().map_or(&[], Vec::as_slice)
}

fn text_of(node: Node<'_, '_>) -> String {
    node.descendants()
        .filter(|n| n.is_text())
        .map(|n| n.text().unwrap())
        .collect::<String>()
        .trim()
        .to_owned()
}

/// Vector by vector, place by place and label by label: the two writers walk the figure each on its own.
#[test]
fn the_json_says_what_the_svg_says() {
    for name in ["s000-ch3a-1", "s000-ch4-6-a", "s000-ch7-9-36", "s002-8"] {
        let figure = figure(name, None);
        let text = svg::write(&figure);
        let document = Document::parse(&text).unwrap();
        let json: Value = serde_json::from_str(&json::write(&figure)).unwrap();
        assert_eq!((&json["format"], &json["version"]), (&"linkgram-figure".into(), &1.into()));
        let pages: Vec<Node> = document.descendants().filter(|n| has(*n, "page")).collect();
        assert_eq!(pages.len(), list(&json, "pages").len());
        let height = figure.height / pages.len() as f64;
        let (mut vectors, mut labels) = (0, 0);
        for ((i, drawn), told) in pages.iter().enumerate().zip(list(&json, "pages")) {
            let on_page = |[x, y]: [f64; 2]| [x, y - i as f64 * height];
            let near = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]) < 2e-6;
            let panels: Vec<Node> = drawn.descendants().filter(|n| has(*n, "panel")).collect();
            assert_eq!(panels.len(), list(told, "panels").len(), "{name}");
            for (drawn, told) in panels.iter().zip(list(told, "panels")) {
                let drawing = drawn.children().find(|n| n.has_attribute("data-scale")).unwrap();
                let scale: f64 = drawing.attribute("data-scale").unwrap().parse().unwrap();
                assert_eq!(told["scale"]["per_mm"].as_f64(), Some(scale));
                let of = |class: &'static str| drawn.descendants().filter(move |n| has(*n, class));
                assert_eq!(of("vector").count(), list(told, "vectors").len());
                for (drawn, told) in of("vector").zip(list(told, "vectors")) {
                    let data = |key: &str| drawn.attribute(format!("data-{key}").as_str());
                    assert_eq!(told["quantity"].as_str(), data("quantity"));
                    assert_eq!(told["tail"]["label"].as_str(), data("from"));
                    assert_eq!(told["head"]["label"].as_str(), data("to"));
                    let value: f64 = data("value").unwrap().parse().unwrap();
                    assert_eq!(told["value"].as_f64(), Some(value));
                    for way in ["parallel", "perpendicular"] {
                        assert_eq!(told["claim"][way].as_str(), data(way));
                    }
                    let marks: Vec<Node> = drawn.children().filter(Node::is_element).collect();
                    let (tail, head) = (on_page(start(marks[0])), on_page(start(marks[marks.len() - 1])));
                    let (told_tail, told_head) = (pair(&told["tail"]["at_mm"]), pair(&told["head"]["at_mm"]));
                    assert!(near(told_tail, tail) && near(told_head, head), "{name}: {told}");
                    if told["as_point"] == false {
                        let length = libm::hypot(told_head[0] - told_tail[0], told_head[1] - told_tail[1]);
                        assert!((length - told["length_mm"].as_f64().unwrap()).abs() < 3e-6, "{told}");
                        assert!((length * scale - value).abs() < 3e-6 * scale, "{told}");
                    }
                    vectors += 1;
                }
                assert_eq!(of("ray").filter(|n| n.has_tag_name("g")).count(), list(told, "lines").len());
                let images = of("image").filter(|n| n.has_attribute("data-point"));
                for image in images {
                    let point = image.attribute("data-point").unwrap();
                    let at = on_page(start(image.first_element_child().unwrap()));
                    let told = list(told, "points").iter().find(|p| p["name"] == point);
                    assert!(near(pair(&told.unwrap()["at_mm"]), at), "{name}: {point}");
                }
                let texts: BTreeSet<String> =
                    drawn.descendants().filter(|n| n.has_tag_name("text")).map(text_of).collect();
                let told: Vec<&str> =
                    list(told, "labels").iter().map(|label| label["text"].as_str().unwrap()).collect();
                assert!(told.iter().all(|label| texts.contains(*label)), "{name}: {told:?}");
                labels += told.len();
            }
            let inside = |n: Node| n.ancestors().any(|a| has(a, "panel"));
            let outside = drawn.descendants().filter(|n| n.has_tag_name("text") && !inside(*n));
            let texts: Vec<String> = outside.map(text_of).collect();
            let told: Vec<&str> = list(told, "texts").iter().map(|t| t["text"].as_str().unwrap()).collect();
            assert_eq!(texts, told, "{name}");
        }
        assert!(vectors > 2 && labels > 8, "{name}: {vectors} vectors, {labels} labels");
    }
}

/// Problem 3-1: V = ωl = 10 rad/s × 15 cm, and Aⁿ = ω²l = 100 × 15 cm/s², in SI; at 5 cm/s and 50 cm/s² per
/// millimetre 30 mm each.
#[test]
fn the_json_tells_quantities_in_si_and_on_paper() {
    let json = json::value(&figure("s000-ch3a-1", None));
    for (kind, quantity, si) in [("velocity", "v(A)", 1.5), ("acceleration", "a(A)", 15.0)] {
        let panels = list(&json, "pages").iter().flat_map(|page| list(page, "panels"));
        let panel = panels.into_iter().find(|panel| panel["kind"] == kind).unwrap();
        let vector = list(panel, "vectors").iter().find(|v| v["quantity"] == quantity).unwrap();
        assert!((vector["si"].as_f64().unwrap() - si).abs() < 1e-12, "{vector}");
        assert!((vector["length_mm"].as_f64().unwrap() - 30.0).abs() < 1e-6, "{vector}");
    }
}

#[test]
fn every_box_of_a_label_holds_its_start() {
    let json = json::value(&figure("s000-ch3a-1", Some("velocity")));
    let panel = &json["pages"][0]["panels"][0];
    for label in list(panel, "labels") {
        let corners: Vec<f64> = list(label, "box_mm").iter().map(|v| v.as_f64().unwrap()).collect();
        let [x, y] = pair(&label["at_mm"]);
        let size = label["size_mm"].as_f64().unwrap();
        assert!(x >= corners[0] - size && x <= corners[2], "{label}");
        assert!(y >= corners[1] && y <= corners[3] + size, "{label}");
    }
}

/// Figures of one page do not answer to each other's names.
#[test]
fn title_and_description_come_first_and_have_names_of_their_own() {
    let mut seen = BTreeSet::new();
    for single in ["skeleton", "velocity", "acceleration"] {
        let text = svg::write(&figure("s000-ch3a-1", Some(single)));
        let document = Document::parse(&text).unwrap();
        let root = document.root_element();
        assert_eq!((root.attribute("role"), root.attribute("lang")), (Some("img"), Some("en")));
        let first: Vec<Node> = root.children().filter(Node::is_element).take(2).collect();
        assert!(first[0].has_tag_name("title") && first[1].has_tag_name("desc"));
        let named: Vec<&str> = first.iter().map(|n| n.attribute("id").unwrap()).collect();
        assert_eq!(root.attribute("aria-labelledby").unwrap(), named.join(" "));
        for id in document.descendants().filter_map(|n| n.attribute("id")) {
            assert!(seen.insert(id.to_owned()), "{id} stands in two figures");
        }
    }
}

/// A theme changes paint and nothing else.
#[test]
fn a_theme_moves_no_ink() {
    let figure = figure("s000-ch3a-1", None);
    let bare = |theme| {
        let text = svg::write_in(&figure, theme);
        let mut out = String::new();
        for piece in text.split('#') {
            out.push_str(piece.strip_prefix(|c: char| c.is_ascii_hexdigit()).map_or(piece, |_| &piece[6..]));
        }
        // The root with its fill, title and description, whose names are those of another figure.
        let lines = out.lines().skip(3).filter(|line| !line.contains("class=\"paper\""));
        lines.map(|line| format!("{line}\n")).collect::<String>()
    };
    assert!(bare(Theme::Mono) == bare(Theme::Colour));
    assert!(bare(Theme::Mono) == bare(Theme::Dark));
    let colour = svg::write_in(&figure, Theme::Colour);
    let document = Document::parse(&colour).unwrap();
    for (polygon, blue) in [("velocity", "#0072b2"), ("acceleration", "#d55e00")] {
        let polygon = document.descendants().find(|n| has(*n, polygon) && has(*n, "polygon")).unwrap();
        let heads = polygon.descendants().filter(|n| has(*n, "head"));
        assert!(heads.map(|n| n.attribute("fill")).all(|fill| fill == Some(blue)));
    }
    assert!(!svg::write(&figure).contains("#0072b2"), "mono has no colour");
}

#[test]
fn every_sheet_can_be_written_for_latex() {
    for example in sheets::examples() {
        let scene = linkgram::scene::read(&std::fs::read_to_string(&example.path).unwrap(), "x").unwrap();
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
        let text = tex::write(&figure, Theme::Mono).unwrap_or_else(|e| panic!("{}: {e}", example.name));
        // What is not ASCII is a letter of a title, or in a comment.
        let body = text.lines().filter(|line| !line.starts_with('%')).collect::<String>();
        assert!(body.is_ascii(), "{}: {:?}", example.name, body.chars().find(|c| !c.is_ascii()));
        for (open, close) in [("\\begin{scope}", "\\end{scope}"), ("{", "}")] {
            let escaped = |text: &str| body.matches(&format!("\\{text}")).count();
            let count =
                |text: &str| body.matches(text).count() - if text.len() == 1 { escaped(text) } else { 0 };
            assert_eq!(count(open), count(close), "{}: {open}", example.name);
        }
    }
}

/// Words of Arabic script are outlines: nothing but ASCII is left for LaTeX, and no word is lost.
#[test]
fn arabic_and_persian_can_be_written_for_latex() {
    for language in [Language::Arabic, Language::ArabicAjala, Language::Persian] {
        let path = sheets::root().join("examples/s000-ch3a-1.json");
        let scene = linkgram::scene::read(&std::fs::read_to_string(path).unwrap(), "x").unwrap();
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        let figure = sheet::solution(&scene, &solved.solution.construction, language);
        let text = tex::write(&figure, Theme::Mono).unwrap();
        let body: Vec<&str> = text.lines().filter(|line| !line.starts_with('%')).collect();
        assert!(body.iter().all(|line| line.is_ascii()), "{language:?}");
        let mut words = 0;
        figure.root.walk(&mut |node| {
            if let sheet::figure::Node::Text(text) = node {
                words += text
                    .runs
                    .iter()
                    .filter(|run| run.face.is_arabic() && !run.text.trim().is_empty())
                    .count();
            }
        });
        let set = body.iter().filter(|line| line.starts_with("\\linkgramword{")).count();
        assert!(words > 100 && set == words, "{language:?}: {set} of {words} words");
        let (open, close) = (text.matches("\\begin{scope}").count(), text.matches("\\end{scope}").count());
        assert_eq!(open, close);
    }
}

/// The text of a line of Arabic script for programs: words apart, brackets as they are written.
#[test]
fn arabic_lines_are_told_with_their_blanks() {
    let path = sheets::root().join("examples/s000-ch3a-1.json");
    let scene = linkgram::scene::read(&std::fs::read_to_string(path).unwrap(), "x").unwrap();
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    let json = json::value(&sheet::solution(&scene, &solved.solution.construction, Language::Arabic));
    assert_eq!(json["pages"][0]["panels"][0]["caption"], "(أ) المخطط الحركي، مقياس الرسم 1\u{a0}:\u{a0}10");
    let pages = json["pages"].as_array().unwrap();
    let lines = pages.iter().flat_map(|page| list(page, "texts")).map(|t| t["text"].as_str().unwrap());
    let sentence = "نختار القطب o، وهو صورة الهيكل كله.";
    assert!(lines.into_iter().any(|line| line == sentence));
}

/// One thing asked is not told as many; of two, Arabic has a dual.
#[test]
fn a_question_counts_what_it_asks() {
    let path = sheets::root().join("examples/s000-ch4-1.json");
    let mut text: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    for (find, told) in [
        (&["v(B)"][..], ["the velocity VB", "السرعة VB", "السرعة VB", "سرعت VB"]),
        (&["a(B)"], ["the acceleration AB", "التسارع AB", "العجلة AB", "شتاب AB"]),
        (
            &["a(B)", "a(G)"],
            ["the accelerations AB and AG", "التسارعان AB و AG", "العجلتان AB و AG", "شتاب‌های AB و AG"],
        ),
        (
            &["v(A)", "v(B)", "v(G)"],
            [
                "the velocities VA, VB and VG",
                "السرعات VA، VB و VG",
                "السرعات VA، VB و VG",
                "سرعت‌های VA، VB و VG",
            ],
        ),
    ] {
        text["find"] = find.into();
        let scene = linkgram::scene::read(&text.to_string(), "x").unwrap();
        let scales = sheet::scale::for_question;
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, scales).unwrap();
        for (language, told) in Language::ALL.into_iter().zip(told) {
            let figure = sheet::question(&scene, &solved.solution.construction, language);
            let json = json::value(&figure);
            let pages = json["pages"].as_array().unwrap();
            let lines = pages.iter().flat_map(|page| list(page, "texts"));
            let lines: Vec<&str> = lines.map(|t| t["text"].as_str().unwrap()).collect();
            assert!(lines.contains(&told), "{language:?}: {told} is not among {lines:?}");
        }
    }
}

/// What is asked by two methods is one quantity, and a ratio is no velocity.
#[test]
fn a_question_tells_methods_and_ratios_apart() {
    let path = sheets::root().join("examples/centres/four-bar.json");
    let scene = linkgram::scene::read(&std::fs::read_to_string(path).unwrap(), "x").unwrap();
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_question).unwrap();
    let json = json::value(&sheet::question(&scene, &solved.solution.construction, Language::English));
    let pages = json["pages"].as_array().unwrap();
    let lines: Vec<&str> =
        pages.iter().flat_map(|page| list(page, "texts")).map(|t| t["text"].as_str().unwrap()).collect();
    for told in [
        "the velocity VB\u{a0}(by gauge line, link to link)",
        "the angular velocity ω4\u{a0}(by instant centres, line of centres)",
        "the ratios ω4/ω2\u{a0}(by instant centres) and T4/T2\u{a0}(by instant centres)",
    ] {
        assert!(lines.contains(&told), "{told} is not among {lines:?}");
    }
}

#[test]
fn formats_have_their_names() {
    for format in Format::ALL {
        assert_eq!(Format::from_name(&format.name().to_uppercase()), Some(format));
    }
}

#[cfg(feature = "pdf")]
mod pdf {
    use super::*;
    use linkgram::render::pdf::render;

    #[test]
    fn a_sheet_is_a_document_of_its_pages_without_a_date() {
        let sheet = figure("s000-ch3a-1", None);
        let bytes = render(&sheet, Theme::Mono).unwrap();
        assert_eq!(bytes, render(&sheet, Theme::Mono).unwrap());
        let text = String::from_utf8_lossy(&bytes);
        assert!(text.starts_with("%PDF-1.7") && text.trim_end().ends_with("%%EOF"));
        let pages = text.matches("/Type/Page/").count() + text.matches("/Type /Page\n").count();
        assert_eq!(pages, 2, "A4 twice");
        for word in ["CreationDate", "ModDate", "xmp:CreateDate"] {
            assert!(!text.contains(word), "{word}");
        }
    }

    /// Characters that no typeface has, of other scripts and of none, in every theme.
    #[test]
    fn no_title_stops_the_writer() {
        for title in
            ["", "\u{0}\u{7}\u{feff}", "🎓 \u{202e}abc", "機構學 סינמטיקה تسارع ۱۲۳", "e\u{301}\u{200d}ﬁ"]
        {
            let text = std::fs::read_to_string(sheets::root().join("examples/s000-ch3a-1.json")).unwrap();
            let mut scene = linkgram::scene::read(&text, "x").unwrap();
            scene.title.plain = Some(title.to_owned());
            scene.title.by_language.clear();
            let solved =
                linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
            let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
            for theme in Theme::ALL {
                assert!(render(&figure, theme).unwrap().len() > 1000, "{title:?}");
            }
            assert!(Document::parse(&svg::write(&figure)).is_ok(), "{title:?}");
            assert!(serde_json::from_str::<Value>(&json::write(&figure)).is_ok(), "{title:?}");
        }
    }

    #[test]
    fn a_page_beyond_what_pdf_allows_is_refused() {
        let mut figure = figure("s000-ch3a-1", Some("velocity"));
        figure.width = 6000.0;
        let error = render(&figure, Theme::Mono).unwrap_err().to_string();
        assert!(error.contains("6000 mm") && error.contains("5080 mm"), "{error}");
    }
}

/// Every scene that has a sheet, in every language, as question and as solution, in every format. Takes a minute and
/// a half on two cores: `cargo test --release --test all formats:: -- --ignored`; with `LINKGRAM_SHEETS=FOLDER` the PNGs are kept there, to be
/// looked at.
#[cfg(all(feature = "png", feature = "pdf"))]
mod acceptance {
    use super::*;
    use linkgram::render::{self, Options};
    use linkgram::sheet::figure::Node as Ink;
    use linkgram::sheet::overlap::overlaps;
    use std::path::PathBuf;
    use std::sync::Mutex;

    fn scenes() -> Vec<PathBuf> {
        let folders = ["", "/centres", "/constructions", "/errata", "/exam", "/pairs"];
        let folders = folders.map(|folder| format!("examples{folder}")).into_iter();
        let folders = folders.chain(["src/catalogue", "src/sheet/tests"].map(str::to_owned));
        let files = folders.flat_map(|folder| std::fs::read_dir(sheets::root().join(folder)).unwrap());
        let mut all: Vec<PathBuf> = files.map(|entry| entry.unwrap().path()).collect();
        all.retain(|path| path.extension().is_some_and(|e| e == "json"));
        all.sort();
        all
    }

    /// What is wrong with the sheets of a scene.
    fn faults(path: &std::path::Path, keep: Option<&PathBuf>) -> Vec<String> {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = linkgram::scene::read(&std::fs::read_to_string(path).unwrap(), &name).unwrap();
        let mut bad = Vec::new();
        for question in [true, false] {
            let scales = if question { sheet::scale::for_question } else { sheet::scale::for_scene };
            let solved = match linkgram::solve::solve(&scene, Extent::WholeSkeleton, scales) {
                Ok(solved) => solved,
                Err(error) => return vec![format!("{name}: {error}")],
            };
            let construction = &solved.solution.construction;
            for language in Language::ALL {
                let figure = match question {
                    true => sheet::question(&scene, construction, language),
                    false => sheet::solution(&scene, construction, language),
                };
                let which =
                    format!("{name}.{}.{}", if question { "question" } else { "solution" }, figure.language);
                bad.extend(overlaps(&figure).into_iter().map(|overlap| format!("{which}: {overlap:?}")));
                figure.root.walk(&mut |node| {
                    let Ink::Text(text) = node else { return };
                    for run in &text.runs {
                        let lacking = run.text.chars().filter(|c| !run.face.has(*c) && *c != '\u{200c}');
                        bad.extend(lacking.map(|c| format!("{which}: no glyph for {c:?} in {:?}", run.text)));
                    }
                });
                for format in Format::ALL {
                    let options = Options { dpi: 70.0, ..Options::default() };
                    match render::render(&figure, format, &options) {
                        Err(error) => bad.push(format!("{which}: {error}")),
                        Ok(bytes) => {
                            if let (Format::Png, Some(folder)) = (format, keep) {
                                std::fs::write(folder.join(format!("{which}.png")), bytes).unwrap();
                            }
                        }
                    }
                }
            }
        }
        bad
    }

    #[test]
    #[ignore = "minutes; see the module"]
    fn every_scene_in_every_language_and_format() {
        let keep = std::env::var_os("LINKGRAM_SHEETS").map(PathBuf::from);
        if let Some(folder) = &keep {
            std::fs::create_dir_all(folder).unwrap();
        }
        let (rest, found) = (Mutex::new(scenes()), Mutex::new(Vec::new()));
        std::thread::scope(|scope| {
            for _ in 0..std::thread::available_parallelism().map_or(1, usize::from) {
                scope.spawn(|| {
                    while let Some(path) = { rest.lock().unwrap().pop() } {
                        let bad = faults(&path, keep.as_ref());
                        found.lock().unwrap().extend(bad);
                    }
                });
            }
        });
        let mut found = found.into_inner().unwrap();
        found.sort();
        assert!(found.is_empty(), "{} faults\n{}", found.len(), found.join("\n"));
    }
}

#[cfg(feature = "png")]
mod outlines {
    use super::*;
    use linkgram::render::outline;
    use linkgram::render::png::render_svg;

    /// Text as outlines is the very picture of text as text, dot by dot.
    #[test]
    fn outlined_text_is_the_same_picture() {
        let figure = figure("s000-ch3a-1", None);
        let live = svg::write(&figure);
        let outlined = outline::write(&figure, Theme::Mono).unwrap();
        assert!(!outlined.contains("<text") && !outlined.contains("<tspan"));
        let count = |text: &str, of: &str| text.matches(of).count();
        assert_eq!(count(&live, "<text"), count(&outlined, "aria-label="));
        assert_eq!(count(&live, "data-"), count(&outlined, "data-"));
        let pixels = |svg: &str| {
            resvg::tiny_skia::Pixmap::decode_png(&render_svg(svg, 100.0).unwrap()).unwrap().data().to_vec()
        };
        let (a, b) = (pixels(&live), pixels(&outlined));
        let moved = a.iter().zip(&b).filter(|(a, b)| a.abs_diff(**b) > 8).count();
        let dark = a.iter().filter(|level| **level < 128).count();
        // Where two letters touch, one path covers once what two cover twice.
        assert!(moved < dark / 1000, "{moved} of {dark} dark levels differ");
    }
}
