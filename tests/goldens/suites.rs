//! Suites as users have them: a folder of scenes, goldens beside them, and what becomes of a golden when something
//! changes.

use std::path::{Path, PathBuf};
use std::process::Command;

use linkgram::golden::{Checked, GoldenError, Meaning, Suite, Tier, Verdict, Weight, html};
use serde_json::Value;

use super::root;

/// A folder that goes away with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-golden-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    /// With one scene of the examples in it, blessed.
    fn blessed(name: &str, scene: &str) -> Self {
        let folder = Self::new(name);
        folder.write("scene.json", &example(scene));
        folder.suite().bless(&|| {}).unwrap();
        folder
    }

    fn suite(&self) -> Suite {
        Suite::open(&self.0).unwrap()
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.join(name)
    }

    fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap()
    }

    fn write(&self, name: &str, text: &str) {
        std::fs::write(self.path(name), text).unwrap();
    }

    /// The golden of the one scene, looked at.
    fn check(&self) -> Checked {
        let report = self.suite().check(&|| {});
        assert_eq!(report.checked.len(), 1, "{report}");
        report.checked.into_iter().next().unwrap()
    }

    /// The scene with something else in the place of a text that stands in it once.
    fn edit(&self, name: &str, from: &str, to: &str) {
        let text = self.read(name);
        assert_eq!(text.matches(from).count(), 1, "{from}");
        self.write(name, &text.replace(from, to));
    }

    /// Changes the golden's meaning.
    fn tamper(&self, change: impl FnOnce(&mut Value)) {
        let mut value: Value = serde_json::from_str(&self.read("scene.figure.json")).unwrap();
        change(&mut value);
        self.write("scene.figure.json", &value.to_string());
    }

    fn files(&self) -> Vec<String> {
        let mut names: Vec<String> = std::fs::read_dir(&self.0)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn example(name: &str) -> String {
    std::fs::read_to_string(root().join(format!("examples/{name}.json"))).unwrap()
}

fn run(arguments: &[&str], folder: &Path) -> (i32, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn changes(checked: &Checked) -> Vec<(Weight, Tier, String)> {
    match &checked.verdict {
        Verdict::Differs(changes) => changes.iter().map(|c| (c.weight, c.tier, c.what.clone())).collect(),
        other => panic!("{other:?}"),
    }
}

/// The velocity panel's first vector with a length.
fn vector(figure: &mut Value) -> &mut Value {
    let panels = figure["pages"][0]["panels"].as_array_mut().unwrap();
    let panel = panels.iter_mut().find(|panel| panel["kind"] == "velocity").unwrap();
    let vectors = panel["vectors"].as_array_mut().unwrap();
    vectors.iter_mut().find(|vector| vector["length_mm"].as_f64().unwrap() > 10.0).unwrap()
}

fn lengthen(value: &mut Value, factor: f64) {
    *value = (value.as_f64().unwrap() * factor).into();
}

#[test]
fn what_was_blessed_is_the_same_and_is_not_written_again() {
    let folder = Folder::blessed("same", "s000-ch3a-1");
    let mut expected = vec!["scene.figure.json", "scene.json", "scene.scene.json", "scene.svg"];
    if cfg!(feature = "png") {
        expected.insert(2, "scene.png");
    }
    assert_eq!(folder.files(), expected);
    assert_eq!(folder.check().verdict, Verdict::Same);
    assert_eq!(folder.suite().bless(&|| {}).unwrap(), Vec::<String>::new());
    let (code, out, err) = run(&["golden", "check", "."], &folder.0);
    assert_eq!((code, err.as_str()), (0, ""));
    assert_eq!(out.lines().count(), 1, "{out}");
    // The same file that `draw` writes.
    let (_, drawn, _) = run(&["draw", "scene.json", "--format", "json"], &folder.0);
    assert_eq!(drawn, folder.read("scene.figure.json"));
}

/// What changed in the scene is told, what has one cause stands together, the largest change first; and where the scene
/// is as it was, that is told. The same as JUnit's XML.
#[test]
fn a_change_is_told_with_its_cause() {
    let folder = Folder::blessed("cause", "s000-ch3a-1");
    folder.write("suite.json", r#"{ "figures": [{ "scenes": ["scene.json"] }, { "scenes": ["scene.json"], "as": "question", "name": "*.question" }] }"#);
    folder.suite().bless(&|| {}).unwrap();
    let from = r#""joins": ["O2", "A"], "length": 15"#;
    folder.edit("scene.json", from, r#""joins": ["O2", "A"], "length": 15.3"#);
    let (code, out, _) = run(&["golden", "check", ".", "--junit", "golden.xml"], &folder.0);
    assert_eq!(code, 1, "{out}");
    assert!(out.starts_with("the scene changed: links.2.length 15 → 15.3 (2 goldens)\nscene"), "{out}");
    let report = folder.suite().check(&|| {});
    for one in &report.checked {
        let Verdict::Differs(changes) = &one.verdict else { panic!("{one:?}") };
        let numbers: Vec<u64> =
            changes.iter().filter(|c| c.weight == Weight::Number).map(|c| c.size).collect();
        assert!(numbers.is_sorted_by(|a, b| a >= b), "{numbers:?}");
    }
    let xml = folder.read("golden.xml");
    let document = roxmltree::Document::parse(&xml).unwrap();
    let suite = document.descendants().find(|n| n.has_tag_name("testsuite")).unwrap();
    assert_eq!((suite.attribute("tests"), suite.attribute("failures")), (Some("2"), Some("2")));
    let failure = document.descendants().find(|n| n.has_tag_name("failure")).unwrap();
    assert_eq!(failure.attribute("message"), Some("the scene changed: links.2.length 15 → 15.3"));
    // The scene as it was, and a figure that is not: another program drew it.
    folder.edit("scene.json", r#""length": 15.3"#, r#""length": 15"#);
    folder.tamper(|figure| figure["title"] = "another".into());
    let (_, out, _) = run(&["golden", "check", "."], &folder.0);
    assert!(out.contains("the scene is as it was: the program draws it otherwise"), "{out}");
}

#[test]
fn a_moved_label_is_cosmetic() {
    let folder = Folder::blessed("label", "s000-ch3a-1");
    folder.tamper(|figure| {
        let labels = figure["pages"][0]["panels"][0]["labels"].as_array_mut().unwrap();
        let label = labels.iter_mut().find(|label| label["text"] == "A").unwrap();
        label["at_mm"][0] = (label["at_mm"][0].as_f64().unwrap() + 2.0).into();
    });
    let checked = folder.check();
    let changes = changes(&checked);
    assert_eq!(checked.verdict.weight(), Some(Weight::Cosmetic));
    let told = "skeleton: labels moved by 2 mm: “A”".to_owned();
    assert_eq!(changes, [(Weight::Cosmetic, Tier::Meaning, told)]);
    let (code, out, _) = run(&["golden", "check", "."], &folder.0);
    assert_eq!(code, 1);
    assert!(out.ends_with("golden: 0 of 1 as blessed; 1 cosmetic\n") || !cfg!(feature = "png"), "{out}");
}

#[test]
fn a_vector_half_a_percent_too_long_is_a_changed_number() {
    // Its value and its ink; its value alone; its ink alone.
    for (value, ink) in [(true, true), (true, false), (false, true)] {
        let folder = Folder::blessed(&format!("vector-{value}-{ink}"), "s000-ch3a-1");
        folder.tamper(|figure| {
            let vector = vector(figure);
            if value {
                lengthen(&mut vector["value"], 1.0 / 1.005);
                lengthen(&mut vector["si"], 1.0 / 1.005);
            }
            if ink {
                for axis in 0..2 {
                    let tail = vector["tail"]["at_mm"][axis].as_f64().unwrap();
                    let head = vector["head"]["at_mm"][axis].as_f64().unwrap();
                    vector["head"]["at_mm"][axis] = (tail + (head - tail) / 1.005).into();
                }
            }
        });
        let checked = folder.check();
        let changes = changes(&checked);
        assert_eq!(changes.len(), 1, "{changes:?}");
        assert_eq!(changes[0].0, Weight::Number);
        assert!(changes[0].2.contains("(+0.500 %)"), "{changes:?}");
    }
}

/// The whole way: half a percent more speed, and every velocity is that much longer.
#[test]
fn a_faster_crank_is_a_changed_number_in_every_tier_and_is_blessed_with_its_reason() {
    let folder = Folder::blessed("crank", "s000-ch3a-1");
    folder.edit("scene.json", "10 rad/s cw", "10.05 rad/s cw");
    let checked = folder.check();
    let changes = changes(&checked);
    let of_velocity = |(weight, _, what): &&(Weight, Tier, String)| {
        *weight == Weight::Number && what.starts_with("velocity, v(")
    };
    let velocities: Vec<_> = changes.iter().filter(of_velocity).collect();
    assert!(velocities.len() >= 3, "{changes:#?}");
    assert!(velocities.iter().all(|(_, _, what)| what.contains("(+0.500 %)")), "{velocities:#?}");
    for tier in Tier::built() {
        assert!(changes.iter().any(|(_, seen, _)| seen == tier), "{tier:?}");
    }
    let page = html(&folder.suite().check(&|| {}));
    assert!(page.contains("<section class=\"number\"") && page.contains("data:image/"));
    let outside = ["src=\"http", "href=\"http", "<script", "url(http"];
    assert!(!outside.iter().any(|reference| page.contains(reference)), "the page stands alone");

    let lines = folder.suite().bless(&|| {}).unwrap();
    assert_eq!(lines.len(), 1);
    let tiers = if cfg!(feature = "png") { "meaning, SVG, pixels" } else { "meaning, SVG" };
    assert!(lines[0].starts_with(&format!("scene: number, in {tiers}: ")), "{lines:?}");
    assert_eq!(folder.check().verdict, Verdict::Same);
}

#[test]
fn another_theme_changes_no_meaning() {
    let folder = Folder::blessed("theme", "s000-ch3a-1");
    folder.edit("scene.json", "\"sheet\": {", "\"sheet\": { \"theme\": \"colour\",");
    let changes = changes(&folder.check());
    assert!(changes.iter().all(|(weight, tier, _)| *weight == Weight::Cosmetic && *tier != Tier::Meaning));
}

#[test]
fn a_vector_that_is_gone_a_swapped_claim_and_another_word_are_content() {
    let folder = Folder::blessed("content", "s000-ch3a-1");
    let mut told = Vec::new();
    folder.tamper(|figure| {
        figure["title"] = "Another title".into();
        let vector = vector(figure);
        vector["quantity"] = "v(Z)".into();
        let panels = figure["pages"][0]["panels"].as_array_mut().unwrap();
        let velocity = panels.iter_mut().find(|panel| panel["kind"] == "velocity").unwrap();
        let others =
            velocity["vectors"].as_array_mut().unwrap().iter_mut().filter(|v| v["quantity"] != "v(Z)");
        let mut claims = others.map(|v| &mut v["claim"]);
        let claimed = claims.find(|claim| claim["perpendicular"].is_string()).unwrap();
        *claimed = serde_json::json!({ "parallel": claimed["perpendicular"] });
    });
    for (weight, _, what) in changes(&folder.check()) {
        assert_eq!(weight, Weight::Content, "{what}");
        told.push(what);
    }
    for part in ["title: ", "the vector v(Z)", "a new vector ", "claimed ⊥ "] {
        assert!(told.iter().any(|what| what.contains(part)), "{part}: {told:#?}");
    }
}

#[test]
fn missing_unreadable_and_extra_goldens_are_told_apart() {
    let folder = Folder::blessed("files", "s000-ch3a-1");
    folder.write("notes.svg", "<svg/>");
    folder.write("gone.figure.json", "{}");
    let report = folder.suite().check(&|| {});
    let words = |report: &linkgram::golden::Report| {
        let words = report.checked.iter().map(|one| (one.name.clone(), one.verdict.word()));
        words.collect::<Vec<_>>()
    };
    assert_eq!(words(&report), [("scene".to_owned(), "same"), ("gone".to_owned(), "extra")]);
    assert_eq!(run(&["golden", "check", "."], &folder.0).0, 1);
    let lines = folder.suite().bless(&|| {}).unwrap();
    assert_eq!(lines, ["gone: left alone, though no scene draws it"]);
    assert!(folder.path("gone.figure.json").exists() && folder.path("notes.svg").exists());
    std::fs::remove_file(folder.path("gone.figure.json")).unwrap();

    std::fs::remove_file(folder.path("scene.svg")).unwrap();
    assert!(matches!(folder.check().verdict, Verdict::Missing(what) if what.contains("scene.svg")));
    std::fs::remove_file(folder.path("scene.figure.json")).unwrap();
    let (code, out, err) = run(&["golden", "check", "."], &folder.0);
    assert_eq!((code, err.as_str()), (1, ""));
    assert!(out.contains("1 missing"), "{out}");

    folder.suite().bless(&|| {}).unwrap();
    for broken in ["{", "{}", r#"{"format":"linkgram-figure","version":99,"pages":[]}"#, "\u{0}"] {
        folder.write("scene.figure.json", broken);
        assert!(matches!(folder.check().verdict, Verdict::Unreadable(_)), "{broken}");
    }
    let (code, out, err) = run(&["golden", "check", "."], &folder.0);
    assert_eq!(code, 2);
    assert!(out.contains("1 unreadable") && err.starts_with("error: ./scene.figure.json: "), "{out}{err}");
    let lines = folder.suite().bless(&|| {}).unwrap();
    assert!(lines[0].starts_with("scene: replaced; it was unreadable"), "{lines:?}");
    assert_eq!(folder.check().verdict, Verdict::Same);
}

#[test]
fn a_refusal_that_is_expected_is_a_golden_of_its_own() {
    let folder = Folder::blessed("refusal", "refusals/dead-centre");
    assert_eq!(folder.files(), ["scene.json", "scene.refusal.txt"]);
    assert_eq!(folder.check().verdict, Verdict::Same);
    assert!(folder.read("scene.refusal.txt").contains("indeterminate"));
    folder.edit("scene.refusal.txt", "links 3 and 4", "links 3 and 5");
    assert_eq!(changes(&folder.check())[0].0, Weight::Number);
    folder.write("scene.refusal.txt", "something else\n");
    assert_eq!(changes(&folder.check())[0].0, Weight::Content);
    // Another scene of that name, which is drawn: then the former golden goes.
    folder.write("scene.json", &example("s000-ch3a-1"));
    assert!(changes(&folder.check())[0].2.contains("drawn now"));
    folder.suite().bless(&|| {}).unwrap();
    assert!(!folder.path("scene.refusal.txt").exists());
    folder.write("scene.json", &example("refusals/dead-centre"));
    assert!(changes(&folder.check())[0].2.contains("refused now"));
    folder.suite().bless(&|| {}).unwrap();
    assert_eq!(folder.files(), ["scene.json", "scene.refusal.txt"]);
}

/// What bears the name of a golden and was never blessed is somebody's own: another scene, a figure drawn by hand. Nothing is
/// written over it, and nothing else is written.
#[test]
fn what_is_no_golden_is_not_written_over() {
    for (name, text) in [
        ("scene.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>"),
        ("scene.png", "a photograph"),
        ("scene.scene.json", "{\"title\": \"the scene of another\"}"),
    ] {
        let folder = Folder::new("own-file");
        folder.write("scene.json", &example("s000-ch3a-1"));
        folder.write(name, text);
        let told = folder.suite().bless(&|| {}).unwrap_err().to_string();
        assert!(told.contains(name) && told.contains("move it away"), "{told}");
        assert_eq!(folder.read(name), text);
        assert_eq!(folder.files(), sorted(["scene.json", name]));
        // Kept as a line a scene needs no such file, and takes none away.
        folder.write("suite.json", r#"{"figures": [{"scenes": ["scene.json"], "keep": "line"}]}"#);
        let suite = folder.suite();
        suite.bless(&|| {}).unwrap();
        assert_eq!(folder.read(name), text);
        std::fs::remove_file(folder.path(name)).unwrap();
        std::fs::remove_file(folder.path("suite.json")).unwrap();
        folder.suite().bless(&|| {}).unwrap();
        assert!(folder.files().iter().any(|file| file == "scene.figure.json"));
    }
}

fn sorted<const N: usize>(mut names: [&str; N]) -> Vec<&str> {
    names.sort_unstable();
    names.to_vec()
}

#[test]
fn a_scene_that_cannot_be_drawn_blesses_nothing() {
    let folder = Folder::blessed("broken", "s000-ch3a-1");
    folder.edit("scene.json", "10 rad/s cw", "11 rad/s cw");
    folder.write("zebra.json", "{");
    let before = folder.read("scene.svg");
    assert!(matches!(folder.suite().bless(&|| {}), Err(GoldenError::Broken(why)) if why.len() == 1));
    assert_eq!(folder.read("scene.svg"), before);
    let (code, _, err) = run(&["golden", "check", "."], &folder.0);
    assert_eq!(code, 2);
    assert!(err.starts_with("error: ./zebra.json:1:1: "), "{err}");
    // One golden by name is blessed all the same.
    let (code, ..) = run(&["golden", "bless", ".", "scene"], &folder.0);
    assert_eq!(code, 0);
    assert_ne!(folder.read("scene.svg"), before);
    // Refused without expecting it.
    let refused = example("refusals/dead-centre").replace("\"expect\": \"indeterminate\"", "\"errata\": []");
    folder.write("zebra.json", &refused);
    let (code, _, err) = run(&["golden", "bless", "."], &folder.0);
    assert!(code == 2 && err.contains("indeterminate") && !folder.path("zebra.svg").exists(), "{err}");
}

#[test]
fn a_suite_says_where_its_scenes_are_and_how_they_are_drawn() {
    let folder = Folder::new("manifest");
    std::fs::create_dir_all(folder.path("scenes/deep")).unwrap();
    folder.write("scenes/deep/one.json", &example("s000-ch3a-1"));
    std::fs::create_dir_all(folder.path("scenes/drafts")).unwrap();
    folder.write("scenes/drafts/one.json", "{");
    std::fs::create_dir_all(folder.path("suite")).unwrap();
    folder.write(
        "suite/suite.json",
        r#"{ "figures": [ { "scenes": ["../scenes"], "except": ["../scenes/drafts"] },
             { "scenes": ["../scenes/deep/one.json"], "as": "question", "lang": "ar", "theme": "dark", "name": "questions/*.ar" } ] }"#,
    );
    let (code, out, err) = run(&["golden", "bless", "suite"], &folder.0);
    assert_eq!((code, err.as_str()), (0, ""), "{out}");
    assert!(folder.read("suite/questions/one.ar.svg").contains("lang=\"ar\""));
    assert!(folder.path("suite/one.figure.json").exists());
    assert_eq!(run(&["golden", "check", "suite"], &folder.0).0, 0);
    std::fs::remove_file(folder.path("scenes/drafts/one.json")).unwrap();
    let wrong = [
        (r#"{ "figures": [ { "scenes": ["../scenes"], "lnag": "ar" } ] }"#, "unknown field `lnag`"),
        (r#"{ "figures": [ { "scenes": ["../scenes"], "lang": "arr" } ] }"#, "unknown `lang` arr"),
        (r#"{ "figures": [ { "scenes": ["../scenes"], "as": "answer" } ] }"#, "unknown `as` answer"),
        (r#"{ "figures": [ { "scenes": ["../scenes"], "name": "../../*" } ] }"#, "not a name in this folder"),
        (r#"{ "figures": [ { "scenes": ["../scenes"], "name": "/tmp/*" } ] }"#, "not a name in this folder"),
        (r#"{ "figures": [ { "scenes": ["../scenes", "../scenes"] } ] }"#, "a second golden of the name one"),
        (r#"{ "figures": [], "figures": [] }"#, "duplicate field"),
        (r#"{ "figures": [] }"#, "no scene in this suite"),
        (r#"{ "dpi": 1e9, "figures": [] }"#, "choose between 10 and 600"),
        ("[]", "suite.json:1:2: invalid length 1, expected an object with `figures`"),
        ("7", "suite.json:1:1: invalid type: integer `7`, expected an object with `figures`"),
        ("", "suite.json:1:0: EOF"),
    ];
    for (text, part) in wrong {
        folder.write("suite/suite.json", text);
        let (code, out, err) = run(&["golden", "check", "suite"], &folder.0);
        assert_eq!((code, out.as_str()), (2, ""), "{text}");
        assert!(err.contains(part) && err.lines().count() == 1, "{text}: {err}");
    }
}

#[test]
fn a_golden_of_one_line_tells_in_which_panel_a_number_changed() {
    let folder = Folder::new("line");
    let listed =
        |keep: &str| format!(r#"{{ "figures": [{{ "scenes": ["scene.json"], "keep": "{keep}" }}] }}"#);
    folder.write("scene.json", &example("s000-ch3a-1"));
    folder.write("suite.json", &listed("files"));
    folder.suite().bless(&|| {}).unwrap();
    assert!(folder.files().contains(&"scene.svg".to_owned()));
    folder.write("suite.json", &listed("line"));
    assert!(matches!(folder.check().verdict, Verdict::Missing(_)));
    folder.suite().bless(&|| {}).unwrap();
    assert_eq!(folder.files(), ["figures.txt", "scene.json", "suite.json"]);
    let look = || folder.suite().remembering(&folder.path("seen")).check(&|| {}).checked.remove(0);
    assert_eq!(look().verdict, Verdict::Same);

    folder.edit("scene.json", "10 rad/s cw", "11 rad/s cw");
    let changed = look();
    let told = changes(&changed);
    assert!(
        told.contains(&(Weight::Number, Tier::Meaning, "velocity: a number changed".to_owned())),
        "{told:?}"
    );
    assert_eq!(told.last().map(|(weight, tier, _)| (*weight, *tier)), Some((Weight::Cosmetic, Tier::Svg)));
    assert!(changed.expected.is_some_and(|before| Some(&before) != changed.actual.as_ref()));

    // A figure that nobody lists, and a line that is none.
    folder.write("other.json", &example("s000-ch3a-1"));
    folder.write("suite.json", &listed("line").replace("scene.json", "other.json"));
    let report = folder.suite().check(&|| {});
    let words: Vec<&str> = report.checked.iter().map(|one| one.verdict.word()).collect();
    assert_eq!(words, ["missing", "extra"]);
    folder.write("figures.txt", "scene and no more\n");
    assert!(
        matches!(Suite::open(&folder.0), Err(GoldenError::File(what)) if what.contains("figures.txt:1:"))
    );
}

/// Whatever is changed in a scene, no golden and no drawing makes the comparison fall over.
#[test]
fn any_two_figures_can_be_compared() {
    let all: Vec<Meaning> = ["s000-ch3a-1", "s000-ch4-1", "constructions/klein", "pairs/whitworth"]
        .iter()
        .map(|name| {
            let path = root().join(format!("golden/{}.figure.json", name.rsplit('/').next().unwrap()));
            Meaning::read(&std::fs::read_to_string(path).unwrap()).unwrap()
        })
        .collect();
    for (i, a) in all.iter().enumerate() {
        for (j, b) in all.iter().enumerate() {
            assert_eq!(a.changes(b).is_empty(), i == j);
        }
    }
}
