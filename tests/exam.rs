//! Exam variants: laws of the draw, the key against an independent solution, the banks as other programs read
//! them, and a folder that is never half-written.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use std::collections::{BTreeMap, BTreeSet};
use std::io::Read;
use std::path::{Path, PathBuf};
use std::process::Command;

use base64::Engine;
use linkgram::check::{Outcome, check};
use linkgram::exam::{self, Drawn, ExamError, Flaw, Terms};
use linkgram::mechanism::quantity::Answer;
use linkgram::scene::Scene;
use linkgram::sheet::{Figure, Language};
use linkgram::solve::solve_analytically;
use roxmltree::{Document, Node};

const SCENES: [&str; 6] = [
    "exam/six-link-slider",
    "exam/crank-and-slider",
    "exam/quick-return",
    "exam/four-bar-forces",
    "exam/rough-slider-crank",
    "exam/flywheel",
];

fn terms(variants: usize) -> Terms {
    common::hand_in::terms(variants, 7, exam::Loose::default())
}

fn drawn(scene: &Scene, variants: usize, workers: usize) -> Drawn {
    exam::draw(scene, &terms(variants), workers, &|_| {}).unwrap()
}

/// Letters and attributes of an SVG that a reader or a program could see, without places on the paper.
fn told(svg: &str) -> String {
    let document = Document::parse(svg).unwrap();
    let mut told = String::new();
    for node in document.descendants() {
        let data = node.attributes().filter(|a| a.name().starts_with("data-")).map(|a| a.value());
        told.extend(data.flat_map(|value| [value, " "]));
        // The glyphs of the typefaces are written in letters and digits that tell nothing.
        let told_by = node.text().filter(|text| !text.contains("@font-face"));
        told.push_str(told_by.unwrap_or_default());
    }
    told
}

#[test]
fn variants_differ_hold_and_are_assembled_alike() {
    for name in SCENES {
        let scene = common::read(&common::example_text(name));
        let drawn = drawn(&scene, 12, 2);
        let side = |scene: &Scene| {
            let extent = linkgram::plan::Extent::WholeSkeleton;
            let solved = linkgram::solve::solve(scene, extent, linkgram::sheet::scale::for_scene).unwrap();
            solved.solution.construction.space.choices
        };
        let own = side(&scene);
        for variant in &drawn.variants {
            // The text is a scene by itself, of which nothing is left of the first one's results.
            let read = common::read(&variant.text);
            assert!(check(&read, 0.01).ok, "{name} {}", variant.name());
            assert!(read.published.is_empty() && read.vary.is_empty());
            assert_eq!(side(&read), own, "{name} {}", variant.name());
            // The key is what the other solver finds.
            let state = solve_analytically(&read).unwrap();
            for answer in &variant.answers {
                let asked = &read.mechanism.asked[answer.asked];
                let value = match (state.answer(&asked.quantity), answer.part.name()) {
                    (Answer::Scalar { value, .. }, "value") => value / asked.unit.si,
                    (Answer::Vector { value: [x, y], .. }, "magnitude") => libm::hypot(x, y) / asked.unit.si,
                    (Answer::Vector { value: [x, y], .. }, "direction") => libm::atan2(y, x).to_degrees(),
                    other => panic!("{name}: {other:?}"),
                };
                let apart = (value - answer.value).abs();
                let turned = if answer.part.name() == "direction" { (360.0 - apart).abs() } else { apart };
                assert!(apart.min(turned) <= 1e-9 * value.abs().max(1.0), "{name}: {value} {answer:?}");
                let printed: f64 = answer.printed().parse().unwrap();
                assert!((printed - answer.value).abs() <= answer.tolerance / 10.0, "{answer:?}");
            }
        }
        // Of any two, one answer at least tells them apart by more than both tolerances.
        for (index, one) in drawn.variants.iter().enumerate() {
            for other in &drawn.variants[..index] {
                let apart = one.answers.iter().zip(&other.answers).any(|(a, b)| {
                    let apart = (a.value - b.value).abs();
                    let turn = if a.part.name() == "direction" { (360.0 - apart).abs() } else { apart };
                    apart.min(turn) > a.tolerance.max(b.tolerance)
                });
                assert!(apart, "{name}: {} and {}", one.name(), other.name());
            }
        }
    }
}

#[test]
fn neither_workers_nor_their_number_change_a_variant() {
    let scene = common::read(&common::example_text("exam/crank-and-slider"));
    let texts = |drawn: &Drawn| -> Vec<String> { drawn.variants.iter().map(|v| v.text.clone()).collect() };
    let one = drawn(&scene, 8, 1);
    let many = drawn(&scene, 8, 5);
    assert_eq!(texts(&one), texts(&many));
    assert_eq!((one.tries, &one.tally), (many.tries, &many.tally));
    // Who asks for fewer gets the first of them.
    assert_eq!(texts(&drawn(&scene, 5, 3)), texts(&one)[..5]);
    let attempts: Vec<u64> = one.variants.iter().map(|v| v.attempt).collect();
    let again = exam::redraw(&scene, &terms(8), &attempts, 2, &|| {}).unwrap().unwrap();
    assert_eq!(again.iter().map(|v| v.text.clone()).collect::<Vec<_>>(), texts(&one));
    let other = exam::draw(&scene, &Terms { seed: 8, ..terms(8) }, 2, &|_| {}).unwrap();
    assert_ne!(texts(&other), texts(&one));
}

/// A crank of 60 on a rod of 100 that cannot pass 90° of an eccentric guide.
const TIGHT: &str = r#"{
    "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
    "links": { "2": { "joins": ["O", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 100 } },
    "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": [0, -30], "angle": 0 } }],
    "near": { "B": [110, -30] },
    "input": { "link": 2, "angle": 20, "omega": "5 rad/s ccw" }, "find": ["v(B)"],
    "vary": VARY }"#;

fn refused(vary: &str, variants: usize) -> ExamError {
    let scene = common::read(&TIGHT.replace("VARY", vary));
    exam::draw(&scene, &terms(variants), 2, &|_| {}).unwrap_err()
}

#[test]
fn impossible_ranges_are_refused_with_what_the_tries_failed_on() {
    // The crank carries A more than 100 mm above the guide: 60 sin θ + 30 < 100 holds always; with a rod of
    // 40 it does not where sin θ > 1/6.
    let error = refused(
        r#"{ "links.3.length": { "from": 30, "to": 40, "step": 5 }, "input.angle": { "from": 40, "to": 140, "step": 20 } }"#,
        5,
    );
    let ExamError::Exhausted { found: 0, wanted: 5, tries: 18, all: true, tally } = &error else {
        panic!("{error:?}")
    };
    assert_eq!(tally.flaws["cannot be assembled"], (18, Flaw::CannotAssemble));
    assert!(
        error
            .to_string()
            .ends_with("after 18 tries, which are all that the ranges give: 18 cannot be assembled"),
        "{error}"
    );
    // With a rod of 92 and the crank upright the rod crosses its guide square: sin φ = 90/92, a crossing of 12°.
    let error = refused(
        r#"{ "links.3.length": { "from": 91.5, "to": 92, "step": 0.5 }, "input.angle": { "from": 89, "to": 91, "step": 1 } }"#,
        2,
    );
    let ExamError::Exhausted { tally, .. } = &error else { panic!("{error:?}") };
    let (count, Flaw::Flat { degrees }) = tally.flaws["have too flat a crossing"] else { panic!("{tally}") };
    assert_eq!(count, 6);
    let [least, most] = [91.5_f64, 92.0].map(|rod| libm::acos(90.0 / rod).to_degrees());
    assert!(degrees > least - 0.1 && degrees < most + 0.1, "{degrees}");
    // Two hundred variants of six scenes.
    let error = refused(r#"{ "input.angle": { "from": 10, "to": 60, "step": 10 } }"#, 200);
    assert_eq!(error, ExamError::TooFew { possible: 6, wanted: 200 });
    // Steps finer than a hand can draw: all answers are the same.
    let error = refused(r#"{ "input.angle": { "from": 30, "to": 30.01, "step": 0.001 } }"#, 2);
    let ExamError::Exhausted { found: 1, tally, .. } = &error else { panic!("{error:?}") };
    assert_eq!(
        tally.flaws["have the answers of another variant, within tolerance"],
        (10, Flaw::Alike { variant: 1 })
    );
    assert_eq!(refused("{}", 3), ExamError::NothingVaries);
}

/// A folder that goes away with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-exam-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        Self(path)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.0.join(name)).unwrap()
    }

    /// Every file with its bytes.
    fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        fn walk(folder: &Path, into: &mut BTreeMap<PathBuf, Vec<u8>>) {
            for entry in std::fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() {
                    walk(&path, into);
                } else {
                    into.insert(path.clone(), std::fs::read(&path).unwrap());
                }
            }
        }
        let mut all = BTreeMap::new();
        walk(&self.0, &mut all);
        all.into_iter().map(|(path, bytes)| (path.strip_prefix(&self.0).unwrap().to_owned(), bytes)).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Runs `linkgram exam` on an example; exit status, standard output, standard error.
fn run(scene: &str, folder: &Folder, more: &[&str]) -> (i32, String, String) {
    run_on(&common::root().join(format!("examples/{scene}.json")), folder, more)
}

fn run_on(scene: &Path, folder: &Folder, more: &[&str]) -> (i32, String, String) {
    let ran = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .arg("exam")
        .arg(scene)
        .arg("-o")
        .arg(&folder.0)
        .args(["--text", "embed"])
        .args(more)
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (ran.status.code().unwrap(), text(ran.stdout), text(ran.stderr))
}

#[test]
fn an_interrupted_run_is_taken_up_and_no_other_exam_is_mixed_in() {
    let folder = Folder::new("resumed");
    let (code, _, err) =
        run("exam/crank-and-slider", &folder, &["--variants", "4", "--seed", "3", "--jobs", "1"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let whole = folder.contents();
    let names: BTreeSet<&str> = whole.keys().map(|path| path.to_str().unwrap()).collect();
    for name in [
        "exam.json",
        "key.csv",
        "key.json",
        "moodle-cloze.en.xml",
        "moodle-numerical.en.01.xml",
        "qti.en.zip",
    ] {
        assert!(names.contains(name), "{names:?}");
    }
    assert_eq!(names.iter().filter(|name| name.starts_with("questions")).count(), 4);
    // As if it had been killed: some files are missing, one was left beside its place.
    std::fs::remove_file(folder.0.join("solutions/002.en.svg")).unwrap();
    std::fs::remove_file(folder.0.join("key.csv")).unwrap();
    std::fs::write(folder.0.join("questions/.linkgram-0123456789abcdef.part"), "<svg").unwrap();
    let (code, out, err) =
        run("exam/crank-and-slider", &folder, &["--variants", "4", "--seed", "3", "--jobs", "3"]);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("3 variants are there already"), "{out}");
    assert!(folder.contents() == whole, "the second run gives other bytes");
    // More of the same exam: the first ones stay.
    let (code, ..) = run("exam/crank-and-slider", &folder, &["--variants", "5", "--seed", "3"]);
    assert_eq!(code, 0);
    let more = folder.contents();
    assert!(
        whole
            .iter()
            .filter(|(path, _)| path.components().count() > 1)
            .all(|(path, bytes)| more[path] == *bytes)
    );
    // Another exam, or fewer of this one.
    for (scene, arguments, complaint) in [
        ("exam/crank-and-slider", ["--variants", "5", "--seed", "4"], "seed: 3 there, 4 here"),
        ("exam/quick-return", ["--variants", "5", "--seed", "3"], "holds another exam (scene:"),
        ("exam/crank-and-slider", ["--variants", "2", "--seed", "3"], "holds 5 variants of this exam"),
    ] {
        let (code, _, err) = run(scene, &folder, &arguments);
        assert!(code == 2 && err.contains(complaint), "{err}");
    }
    assert!(folder.contents() == more, "a refused run changed something");
    let other = Folder::new("other");
    std::fs::create_dir_all(&other.0).unwrap();
    std::fs::write(other.0.join("notes.txt"), "mine").unwrap();
    let (code, _, err) = run("exam/crank-and-slider", &other, &["--variants", "2"]);
    assert!(code == 2 && err.contains("holds other files and no exam.json"), "{err}");
    assert_eq!(other.contents().len(), 1);
}

#[test]
fn a_refused_exam_writes_nothing_and_names_the_place() {
    let folder = Folder::new("refused");
    let scene = std::env::temp_dir().join(format!("linkgram-exam-{}-tight.json", std::process::id()));
    let range = r#"{ "links.3.length": { "from": 30, "to": 40, "step": 5 }, "input.angle": { "from": 40, "to": 140, "step": 20 } }"#;
    std::fs::write(&scene, TIGHT.replace("VARY", range)).unwrap();
    let (code, _, err) = run_on(&scene, &folder, &["--variants", "5"]);
    std::fs::remove_file(&scene).unwrap();
    assert_eq!(code, 2);
    let said = "tight.json:7:13: vary: 0 of 5 variants after 18 tries, which are all that the ranges give: 18 cannot be \
                assembled; help: change the ranges that cause what most tries failed on";
    assert!(err.contains(said), "{err}");
    let (code, _, err) = run("s000-ch3a-1", &folder, &["--variants", "2"]);
    assert!(code == 2 && err.contains("nothing varies; help: say what variants may change"), "{err}");
    // What this build cannot write is told before there is a folder.
    let (code, _, err) = run("exam/crank-and-slider", &folder, &["--variants", "1", "--format", "pdf"]);
    assert!(
        if cfg!(feature = "pdf") { code == 0 } else { code == 2 && err.contains("feature `pdf`") },
        "{err}"
    );
    assert_eq!(folder.0.exists(), cfg!(feature = "pdf"));
}

fn child<'a, 'i>(node: Node<'a, 'i>, name: &str) -> Node<'a, 'i> {
    node.children().find(|n| n.has_tag_name(name)).unwrap()
}

fn text_of(node: Node<'_, '_>) -> String {
    child(node, "text").text().unwrap_or_default().to_owned()
}

#[test]
fn the_banks_say_what_the_key_says_and_their_figures_open() {
    let folder = Folder::new("banks");
    let (code, _, err) = run("exam/quick-return", &folder, &["--variants", "3", "--lang", "en,ar"]);
    assert_eq!((code, err.as_str()), (0, ""));
    let key: Vec<Vec<String>> =
        folder.read("key.csv").lines().skip(1).map(|l| l.split(',').map(str::to_owned).collect()).collect();
    let of_variant = |name: &str| key.iter().filter(|line| line[0] == name).cloned().collect::<Vec<_>>();
    for language in ["en", "ar"] {
        // One numerical bank per number.
        let numbers = of_variant("001").len();
        for number in 1..=numbers {
            let text = folder.read(&format!("moodle-numerical.{language}.{number:02}.xml"));
            let quiz = Document::parse(&text).unwrap();
            let questions: Vec<Node> =
                quiz.root_element().children().filter(|n| n.attribute("type") == Some("numerical")).collect();
            assert_eq!(questions.len(), 3);
            for (index, question) in questions.into_iter().enumerate() {
                let line = &of_variant(&format!("{:03}", index + 1))[number - 1];
                let answer = child(question, "answer");
                assert_eq!(
                    (text_of(answer), child(answer, "tolerance").text().unwrap()),
                    (line[4].clone(), line[5].as_str())
                );
                opens(child(question, "questiontext"), language, &folder);
            }
        }
        assert!(!folder.0.join(format!("moodle-numerical.{language}.{:02}.xml", numbers + 1)).exists());
        let text = folder.read(&format!("moodle-cloze.{language}.xml"));
        let quiz = Document::parse(&text).unwrap();
        let questions = quiz.root_element().children().filter(|n| n.attribute("type") == Some("cloze"));
        for (index, question) in questions.enumerate() {
            let body = text_of(child(question, "questiontext"));
            let parts: Vec<&str> = body.split(":NUMERICAL:=").collect();
            let fields = &parts[1..];
            // What each field is worth stands before it, in the ratio of the key's marks.
            let weights: Vec<f64> = parts[..fields.len()]
                .iter()
                .map(|p| p.rsplit('{').next().unwrap().parse().unwrap())
                .collect();
            let marks: Vec<f64> =
                of_variant(&format!("{:03}", index + 1)).iter().map(|l| l[6].parse().unwrap()).collect();
            for (weight, mark) in weights.iter().zip(&marks) {
                assert!((weight * marks[0] - mark * weights[0]).abs() < 1e-9, "{weights:?} {marks:?}");
            }
            // The solution is told afterwards, as a figure of its own.
            let feedback = child(question, "generalfeedback");
            let file = child(feedback, "file");
            let name = file.attribute("name").unwrap();
            assert!(text_of(feedback).contains(&format!("src=\"@@PLUGINFILE@@/{name}\"")), "{name}");
            assert_eq!(name, format!("{:03}.solution.svg", index + 1));
            let lines = of_variant(&format!("{:03}", index + 1));
            assert_eq!(fields.len(), lines.len());
            for (field, line) in fields.iter().zip(lines) {
                assert!(field.starts_with(&format!("{}:{}", line[4], line[5])), "{field} {line:?}");
            }
            opens(child(question, "questiontext"), language, &folder);
        }
        packaged(&folder, language, &of_variant);
    }
}

/// The figure of a question is there, is named in its text, and is an SVG that tells no answer.
fn opens(question: Node<'_, '_>, language: &str, folder: &Folder) {
    let file = child(question, "file");
    let name = file.attribute("name").unwrap();
    assert!(text_of(question).contains(&format!("src=\"@@PLUGINFILE@@/{name}\"")));
    let bytes = base64::engine::general_purpose::STANDARD.decode(file.text().unwrap()).unwrap();
    tells_no_answer(&String::from_utf8(bytes).unwrap(), &name[..3], language, folder);
}

/// What stands on a question: the numbers of its scene and no number of its key.
fn tells_no_answer(svg: &str, variant: &str, language: &str, folder: &Folder) {
    let document = Document::parse(svg).unwrap();
    assert_eq!(document.root_element().attribute("lang"), Some(language));
    let told = told(svg);
    let number = |c: char| c.is_ascii_digit() || c == '.';
    let tokens: BTreeSet<&str> = told.split(|c| !number(c)).map(|t| t.trim_matches('.')).collect();
    let scene = common::read(&folder.read(&format!("scenes/{variant}.json")));
    let state = solve_analytically(&scene).unwrap();
    for asked in &scene.mechanism.asked {
        let sizes: Vec<f64> = match state.answer(&asked.quantity) {
            Answer::Scalar { value, .. } => vec![value],
            Answer::Vector { value: [x, y], .. } => vec![x, y, libm::hypot(x, y)],
            other => panic!("{other:?}"),
        };
        for size in sizes.into_iter().map(|size| (size / asked.unit.si).abs()).filter(|size| *size > 1e-6) {
            // As the sheet writes numbers, with three figures; a round one may be given by chance.
            let written = format!("{:.2e}", size).parse::<f64>().unwrap().to_string();
            let figures = written.trim_matches(['0', '.']).chars().filter(char::is_ascii_digit).count();
            assert!(
                figures < 3 || !tokens.contains(written.as_str()),
                "{}: {written} stands in {told}",
                asked.name
            );
        }
    }
}

/// The QTI package has what its manifest lists, and its items ask for and mark what the key says.
fn packaged(folder: &Folder, language: &str, key: &dyn Fn(&str) -> Vec<Vec<String>>) {
    let bytes = std::fs::read(folder.0.join(format!("qti.{language}.zip"))).unwrap();
    let mut zip = zip::ZipArchive::new(std::io::Cursor::new(bytes)).unwrap();
    let mut files: BTreeMap<String, String> = BTreeMap::new();
    for index in 0..zip.len() {
        let mut file = zip.by_index(index).unwrap();
        let name = file.name().unwrap().into_owned();
        let mut text = String::new();
        file.read_to_string(&mut text).unwrap();
        files.insert(name, text);
    }
    let manifest = Document::parse(&files["imsmanifest.xml"]).unwrap();
    let listed: BTreeSet<&str> = manifest
        .descendants()
        .filter(|n| n.has_tag_name(("http://www.imsglobal.org/xsd/imscp_v1p1", "file")))
        .map(|n| n.attribute("href").unwrap())
        .collect();
    assert_eq!(listed.len() + 1, files.len());
    assert!(listed.iter().all(|name| files.contains_key(*name)));
    for (name, text) in files.iter().filter(|(name, _)| name.starts_with("items/")) {
        let item = Document::parse(text).unwrap();
        let qti = |local: &'static str| ("http://www.imsglobal.org/xsd/imsqti_v2p1", local);
        let all = |local: &'static str| item.descendants().filter(move |n| n.has_tag_name(qti(local)));
        // The order of the schema's sequence.
        let order =
            ["responseDeclaration", "outcomeDeclaration", "itemBody", "responseProcessing", "modalFeedback"];
        let parts = item.root_element().children().filter(Node::is_element);
        let places: Vec<usize> =
            parts.map(|part| order.iter().position(|o| *o == part.tag_name().name()).unwrap()).collect();
        assert!(places.is_sorted() && places.ends_with(&[1, 2, 3, 4]), "{places:?}");
        let variant = &name[6..9];
        let lines = key(variant);
        assert_eq!(all("textEntryInteraction").count(), lines.len());
        for ((declared, line), entry) in
            all("responseDeclaration").zip(&lines).zip(all("textEntryInteraction"))
        {
            let id = declared.attribute("identifier").unwrap();
            assert_eq!(entry.attribute("responseIdentifier"), Some(id));
            let right = declared.descendants().find(|n| n.has_tag_name(qti("value"))).unwrap();
            assert_eq!(right.text().unwrap(), line[4]);
            let tests: Vec<Node> = all("equal")
                .filter(|e| e.descendants().any(|n| n.attribute("identifier") == Some(id)))
                .collect();
            // A direction is the same a turn later or earlier; a rotation with the wrong sense has a test of its own.
            let turns = line[3].starts_with("rad/");
            assert_eq!(
                tests.len(),
                if line[2] == "direction" {
                    3
                } else if turns {
                    2
                } else {
                    1
                }
            );
            for test in tests {
                assert_eq!(test.attribute("toleranceMode"), Some("absolute"));
                assert_eq!(test.attribute("tolerance").unwrap(), format!("{0} {0}", line[5]));
            }
        }
        let figure = all("img").next().unwrap().attribute("src").unwrap();
        tells_no_answer(&files[figure.strip_prefix("../").unwrap()], variant, language, folder);
    }
}

/// In an Arabic title the dot before a variant's number stands between the last word and the number, and 3-1 is 3-1.
#[test]
fn numbers_of_an_arabic_title_stand_in_their_order() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/exam/crank-and-slider.json");
    let mut scene: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    scene["title"] = serde_json::json!({ "en": "Problem 3-1", "ar": "مسألة 3-1: مرفق" });
    let scene = common::read(&scene.to_string());
    let drawn = drawn(&scene, 1, 1);
    let arabic = linkgram::sheet::Language::from_tag("ar").unwrap();
    let figure = exam::question(&drawn.variants[0].scene, arabic).unwrap();
    let mut runs: Vec<(f64, String)> = Vec::new();
    figure.root.walk(&mut |node| {
        if let linkgram::sheet::figure::Node::Text(text) = node
            && text.class == "title"
        {
            runs.extend(text.runs.iter().map(|run| (run.at.x, run.text.trim().to_owned())));
        }
    });
    runs.retain(|(_, text)| !text.is_empty());
    // From right to left.
    runs.sort_by(|a, b| b.0.total_cmp(&a.0));
    let order: Vec<&str> = runs.iter().map(|(_, text)| text.as_str()).collect();
    assert_eq!(order, ["مسألة", "3-1", ":", "مرفق", "·", "001"]);
}

/// Marks of the scene reach the key, Moodle and QTI; of a slider's vector the sense is worth less than the magnitude; what
/// a hand may miss by more than is allowed is told when the exam is made; and the typed answers are graded by variant.
#[test]
fn marks_tolerances_and_answer_sheets() {
    let folder = Folder::new("marks");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/exam/crank-and-slider.json");
    let mut scene: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
    let find: Vec<String> =
        scene["find"].as_array().unwrap().iter().map(|n| n.as_str().unwrap().to_owned()).collect();
    let slider = find.iter().find(|name| name.starts_with("v(") && !name.contains('/')).unwrap().clone();
    let rate = find.iter().find(|name| name.starts_with("omega")).unwrap().clone();
    scene["sheet"] = serde_json::json!({ "marks": { slider.as_str(): 4, rate.as_str(): 2 } });
    let file = std::env::temp_dir().join(format!("linkgram-exam-{}-marks.json", std::process::id()));
    std::fs::write(&file, scene.to_string()).unwrap();
    let names = std::env::temp_dir().join(format!("linkgram-exam-{}-names.txt", std::process::id()));
    std::fs::write(&names, "Ada\n\nBob, B.\nEve\n").unwrap();
    let more = ["--names", names.to_str().unwrap(), "--max-tolerance", "0.6%", "--loose", "ask"];
    let (code, out, err) = run_on(&file, &folder, &more);
    assert_eq!((code, err.as_str()), (0, ""));
    assert!(out.contains("flagged: ") && out.contains("--max-tolerance"), "{out}");
    assert_eq!(folder.read("names.csv"), "name,variant\nAda,001\n\"Bob, B.\",002\nEve,003\n");
    let key: Vec<Vec<String>> =
        folder.read("key.csv").lines().skip(1).map(|l| l.split(',').map(str::to_owned).collect()).collect();
    let of =
        |name: &str, part: &str| key.iter().find(|l| l[0] == "001" && l[1] == name && l[2] == part).unwrap();
    let mark = |line: &[String]| line[6].parse::<f64>().unwrap();
    let (magnitude, direction) = (mark(of(&slider, "magnitude")), mark(of(&slider, "direction")));
    assert!((magnitude + direction - 4.0).abs() < 1e-9 && magnitude > direction, "{magnitude} {direction}");
    assert!((mark(of(&rate, "value")) - 2.0).abs() < 1e-9);
    for line in key.iter().filter(|line| line[2] == "magnitude" || line[2] == "value") {
        let (value, tolerance): (f64, f64) = (line[4].parse().unwrap(), line[5].parse().unwrap());
        // However strict, two readings off the paper are always allowed.
        let least = if line[2] == "magnitude" { 0.02 } else { 0.0065 };
        assert!(tolerance <= least * value.abs(), "{line:?}");
    }
    // Typed from the answer sheet: two boxes filled, the others empty.
    let typed: String = folder
        .read("answers/002.csv")
        .lines()
        .map(|line| {
            let key = |name: &str, part: &str| {
                key.iter().find(|l| l[0] == "002" && l[1] == name && l[2] == part).unwrap()[4].clone()
            };
            let filled = |name: &str| line.starts_with(&format!("{name},,,,"));
            if line == "student," {
                "student,Bob\n".to_owned()
            } else if filled(&rate) {
                let value = key(&rate, "value");
                let sense = if value.starts_with('-') { "cw" } else { "ccw" };
                line.replacen(",,,,", &format!(",{},,,", value.trim_start_matches('-')), 1)
                    .replace("s,,", &format!("s,{sense},"))
                    + "\n"
            } else if filled(&slider) {
                let value = key(&slider, "magnitude");
                let direction = key(&slider, "direction");
                let line = line.replacen(",,,,", &format!(",{value},,,"), 1);
                line.strip_suffix(',').unwrap().to_owned() + "," + &direction + "\n"
            } else {
                line.to_owned() + "\n"
            }
        })
        .collect();
    let answers = folder.0.join("bob.csv");
    std::fs::write(&answers, &typed).unwrap();
    let output = std::process::Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(["grade", folder.0.to_str().unwrap(), answers.to_str().unwrap()])
        .output()
        .unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{typed}\n{said}{}", String::from_utf8_lossy(&output.stderr));
    let others = find.len() - 2;
    assert!(said.starts_with("Bob\n") && said.contains(&format!("marks: 6 of {}", 6 + others)), "{said}");
    for path in [file, names] {
        std::fs::remove_file(path).unwrap();
    }
}

#[test]
fn the_sheets_of_an_exam_are_those_that_draw_draws() {
    let folder = Folder::new("sheets");
    assert_eq!(run("exam/six-link-slider", &folder, &["--variants", "2"]).0, 0);
    for variant in ["001", "002"] {
        let scene = common::read(&folder.read(&format!("scenes/{variant}.json")));
        assert!(matches!(check(&scene, 0.01).outcome, Outcome::Solved { .. }));
        let question = linkgram::exam::question(&scene, Language::English).unwrap();
        assert_eq!(
            linkgram::render::svg::write_embedded(&question, linkgram::render::theme::Theme::default()),
            folder.read(&format!("questions/{variant}.en.svg"))
        );
        tells_no_answer(&folder.read(&format!("questions/{variant}.en.svg")), variant, "en", &folder);
        let solution = linkgram::exam::solution(&scene, Language::English).unwrap();
        let written = folder.read(&format!("solutions/{variant}.en.svg"));
        assert_eq!(
            linkgram::render::svg::write_embedded(&solution, linkgram::render::theme::Theme::default()),
            written
        );
        let title = Document::parse(&written).unwrap();
        let title =
            title.descendants().find(|n| n.has_tag_name(("http://www.w3.org/2000/svg", "title"))).unwrap();
        assert!(title.text().unwrap().ends_with(&format!(" · {variant}")));
    }
}

/// Whoever hands in the answers of another variant, his own number or a neighbour's, is told so and follows from nothing.
#[test]
fn the_answers_of_another_variant_are_told() {
    use linkgram::grade::{self, GradeSettings, Verdict};
    for name in SCENES {
        let scene = common::read(&common::example_text(name));
        let variants = drawn(&scene, 3, 2).variants;
        let key = exam::json(&scene, &terms(3), &variants).to_string();
        let key = grade::Key::read(&key).unwrap();
        for (own, other) in [(0, 0), (0, 1), (1, 0), (2, 1)] {
            let mut values = serde_json::Map::new();
            for answer in &variants[own].answers {
                let entry = values.entry(answer.name.clone()).or_insert_with(|| serde_json::json!({}));
                match answer.part.name() {
                    "value" if answer.turns => {
                        let sense = if answer.value < 0.0 { "cw" } else { "ccw" };
                        *entry = serde_json::json!({ "value": answer.value.abs(), "sense": sense });
                    }
                    part => entry[part] = answer.value.into(),
                }
            }
            let differ = variants[own].answers.iter().zip(&variants[other].answers);
            let differ = differ.filter(|(a, b)| (a.value - b.value).abs() > 1.5 * b.tolerance).count();
            let graded_as = &variants[other];
            let answers = serde_json::json!({ "values": values }).to_string();
            let mut answers = grade::read_named(&answers, "answers.json", &graded_as.scene).unwrap();
            let found = key.other_variant(&answers, &graded_as.name());
            if own == other {
                assert_eq!(found, None, "{name}");
                continue;
            }
            if differ < 4 {
                continue;
            }
            assert_eq!(found, Some(variants[own].name()), "{name} {own} {other}");
            answers.other_variant = found;
            let report = grade::grade(&graded_as.scene, &answers, &GradeSettings::default()).unwrap();
            assert!(report.to_text().contains("answers of variant"), "{name}");
            assert!(report.quantities.iter().all(|graded| graded.verdict != Verdict::Consistent), "{name}");
        }
    }
}

/// Whoever hands in a place has to know from where it is counted: the sheet has the axes, and says so.
#[test]
fn a_question_of_places_shows_its_axes() {
    let scene = |pivot: &str, find: &str| {
        common::read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": {pivot}, "O4": [150, 30] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 50 }}, "3": {{ "joins": ["A", "B"], "length": 110 }},
                        "4": {{ "joins": ["O4", "B"], "length": 80 }} }},
            "near": {{ "B": [150, 110] }}, "input": {{ "link": 2, "angle": 65, "omega": 10 }}, "find": [{find}] }}"#
        ))
    };
    let lines = |figure: &Figure| crate::legibility::sentences(figure).join(" ").replace('\u{a0}', " ");
    for language in Language::ALL {
        for (pivot, find, asks) in [
            ("[0, 0]", "\"x(B)\"", true),
            ("[30, 20]", "\"I(1,3)\", \"omega(3)\"", true),
            ("[30, 20]", "\"v(B)\"", false),
        ] {
            let scene = scene(pivot, find);
            for figure in [exam::question(&scene, language).unwrap(), exam::card(&scene, language).unwrap()] {
                let svg = linkgram::render::svg::write(&figure);
                assert_eq!(svg.contains("class=\"axes\""), asks, "{pivot} {find}");
                if language == Language::English && asks {
                    let wanted =
                        if pivot == "[0, 0]" { "coordinates of places from O" } else { "at (30 mm, 20 mm)" };
                    assert!(lines(&figure).contains(wanted), "{}", lines(&figure));
                }
            }
        }
    }
}
