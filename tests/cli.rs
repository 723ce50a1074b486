//! The command line as people and programs meet it: exit status, what stands on which stream, the JSON of
//! `solve` and `check`, and that nothing is written where something is wrong.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::{Value, json};

/// A folder that goes away with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-cli-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) {
        std::fs::write(self.0.join(name), text).unwrap();
    }

    /// Every file with its bytes.
    fn contents(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        let entries = std::fs::read_dir(&self.0).unwrap().map(|e| e.unwrap().path());
        entries.filter(|p| p.is_file()).map(|p| (p.clone(), std::fs::read(p).unwrap())).collect()
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

pub(crate) struct Ran {
    pub(crate) code: i32,
    pub(crate) out: String,
    pub(crate) err: String,
}

pub(crate) fn run_in(folder: &Path, arguments: &[&str], input: Option<&[u8]>) -> Ran {
    let mut child = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(arguments)
        .current_dir(folder)
        .stdin(if input.is_some() { Stdio::piped() } else { Stdio::null() })
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    if let Some(input) = input {
        // A program that refuses at once may hang up before it has read everything.
        let _ = child.stdin.take().unwrap().write_all(input);
    }
    let output = child.wait_with_output().unwrap();
    let code = output.status.code().expect("ended by a signal");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    let ran = Ran { code, out: text(output.stdout), err: text(output.stderr) };
    assert!([0, 1, 2].contains(&ran.code), "exit {} is a bug:\n{}", ran.code, ran.err);
    assert!(!ran.err.contains("panicked"), "{}", ran.err);
    assert!(!ran.out.contains('\u{1b}') && !ran.err.contains('\u{1b}'), "colour without a terminal");
    ran
}

fn run(arguments: &[&str]) -> Ran {
    run_in(common::root(), arguments, None)
}

/// A range begins or ends where the scene stands, in the same digits: that place is in it, whatever degrees are rounded to.
#[test]
fn a_range_may_end_at_the_scenes_own_place() {
    for own in [241.75, -85.53, -68.56, 17.31, 203.9] {
        let scene = json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 90 },
                "4": { "joins": ["O4", "B"], "length": 70 }
            },
            "near": { "B": [90, 65] }, "input": { "link": 2, "angle": own, "omega": "1 rad/s" }, "find": ["x(B)"]
        });
        for [from, to] in [[own, own + 40.0], [own - 40.0, own]] {
            let range = [format!("--from={from}"), format!("--to={to}")];
            let arguments = ["sweep", "-", &range[0], &range[1], "--steps", "2"];
            let ran = run_in(common::root(), &arguments, Some(scene.to_string().as_bytes()));
            assert!(ran.code == 0, "{own}: {}", ran.err);
            let rows: Vec<&str> =
                ran.out.lines().filter(|line| line.ends_with(|c: char| c.is_ascii_digit())).collect();
            assert!(rows.len() >= 3, "{own}: {}", ran.out);
        }
    }
}

fn solve_json(text: &str) -> (i32, Value) {
    let ran = run_in(common::root(), &["solve", "-", "--json"], Some(text.as_bytes()));
    assert!(ran.code < 2, "{}", ran.err);
    (ran.code, serde_json::from_str(&ran.out).unwrap())
}

const SIX: &str = "examples/s000-ch3a-1.json";

fn six() -> Value {
    serde_json::from_str(&common::example_text("s000-ch3a-1")).unwrap()
}

/// The error's place, as `file:line:column: `.
fn place<'a>(ran: &'a Ran, file: &str) -> (usize, usize, &'a str) {
    assert_eq!(ran.code, 2, "{}", ran.err);
    assert_eq!(ran.out, "", "results on stdout of a refused scene");
    let start = format!("error: {file}:");
    let rest = ran.err.strip_prefix(start.as_str()).unwrap_or_else(|| panic!("{start}: {}", ran.err));
    assert_eq!(ran.err.matches("error:").count(), 1, "one clear error: {}", ran.err);
    let mut parts = rest.splitn(3, ':');
    let mut number = || parts.next().unwrap().parse::<usize>().unwrap();
    let (line, column) = (number(), number());
    assert!(line >= 1 && column >= 1);
    (line, column, parts.next().unwrap().trim())
}

// --- solve ---------------------------------------------------------------------------------------------

#[test]
fn problem_3_1_has_the_numbers_of_the_contract() {
    let (code, solved) = solve_json(&common::example_text("s000-ch3a-1"));
    assert_eq!(code, 0);
    assert_eq!(solved["degrees_of_freedom"], 1);
    assert_eq!(solved["agreement"]["ok"], true);
    assert!(solved["agreement"]["worst_ratio"].as_f64().unwrap() <= 1.0);
    let quantity = |name: &str| {
        let list = solved["quantities"].as_array().unwrap();
        list.iter().find(|q| q["name"] == name).unwrap_or_else(|| panic!("no {name}"))
    };
    // Issue 2: O4 = (45, 15), guide y = 37, B below O4; half a unit of the last digit.
    let scalars = [
        ("omega(3)", 4.397_03, 5e-6, "rad/s", "ccw"),
        ("omega(4)", 5.843_65, 5e-6, "rad/s", "ccw"),
        ("omega(5)", -1.205_91, 5e-6, "rad/s", "cw"),
        ("alpha(3)", 25.3088, 5e-5, "rad/s^2", "ccw"),
        ("alpha(4)", -43.4273, 5e-5, "rad/s^2", "cw"),
        ("alpha(5)", -18.0658, 5e-5, "rad/s^2", "cw"),
    ];
    for (name, expected, half_digit, unit, sense) in scalars {
        let q = quantity(name);
        assert_eq!((q["unit"].as_str(), q["sense"].as_str()), (Some(unit), Some(sense)), "{name}");
        for key in ["value", "analytic"] {
            let value = q[key].as_f64().unwrap();
            assert!((value - expected).abs() <= half_digit, "{key} of {name}: {value}");
        }
    }
    let d = quantity("a(D)");
    assert_eq!(d["unit"], "cm/s^2");
    assert!((d["magnitude"].as_f64().unwrap() - 1442.94).abs() <= 0.005);
    let analytic: Vec<f64> = d["analytic"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    assert!((libm::hypot(analytic[0], analytic[1]) - 1442.94).abs() <= 0.005);
}

#[test]
fn every_quantity_has_the_fields_of_the_format() {
    let (_, solved) = solve_json(&common::example_text("s000-ch3a-1"));
    for q in solved["quantities"].as_array().unwrap() {
        let name = q["name"].as_str().unwrap();
        let number = |key: &str| q[key].as_f64().unwrap_or_else(|| panic!("{key} of {name}"));
        let [bound, analytic_bound, difference] = ["bound", "analytic_bound", "difference"].map(number);
        assert!(difference <= bound + analytic_bound, "{name}");
        if let Some(value) = q["value"].as_array() {
            let value: Vec<f64> = value.iter().map(|x| x.as_f64().unwrap()).collect();
            let size = libm::hypot(value[0], value[1]);
            assert!((number("magnitude") - size).abs() <= 4.0 * f64::EPSILON * size, "{name}");
            let turned = libm::atan2(value[1], value[0]).to_degrees();
            assert!((number("direction_deg") - turned).abs() <= 1e-12 * 360.0, "{name}");
            assert!(q.get("sense").is_none());
        } else {
            let value = number("value");
            let sense = q.get("sense").and_then(Value::as_str);
            if name.starts_with("omega") || name.starts_with("alpha") {
                assert_eq!(sense, Some(if value > 0.0 { "ccw" } else { "cw" }), "{name}");
            } else {
                assert_eq!(sense, None, "{name}");
            }
        }
        if ["v(", "a("].iter().any(|start| name.starts_with(start)) {
            assert!(number("drawn_mm") > 0.0, "{name} is a vector of a polygon");
        }
    }
}

/// 400 N at 100 N per cm are 40 mm; where no scale is stated a force is a side of several polygons, and has no one length.
#[test]
fn a_force_has_a_length_at_the_stated_scale() {
    let scene = |sheet: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }} }}, "input": {{ "link": 2, "angle": 30 }},
            "loads": [ {{ "name": "P", "on": 2, "at": "A", "force": "400 N", "direction": -90 }} ],
            {sheet} "find": ["F(1,2)"] }}"#
        )
    };
    let (_, solved) = solve_json(&scene(r#""sheet": { "scales": { "force": "100 N per cm" } },"#));
    let drawn = solved["quantities"][0]["drawn_mm"].as_f64().unwrap();
    assert!((drawn - 40.0).abs() < 1e-12, "{drawn}");
    let (_, solved) = solve_json(&scene(""));
    assert!(solved["quantities"][0].get("drawn_mm").is_none());
}

#[test]
fn names_come_back_in_order_and_in_their_units() {
    let mut scene = six();
    scene["find"] = serde_json::json!([
        "alpha(3)", "v(B)", { "name": "v(B)", "unit": "m/s" }, { "name": "omega(4)", "unit": "rpm" },
        { "name": "x(B)", "unit": "in" }, "x(B)", "angle(3)", { "name": "angle(3)", "unit": "rad" },
        "transmission(3/4)", "v(B)"
    ]);
    let (code, solved) = solve_json(&scene.to_string());
    assert_eq!(code, 0);
    let list = solved["quantities"].as_array().unwrap();
    let heads: Vec<(&str, &str)> =
        list.iter().map(|q| (q["name"].as_str().unwrap(), q["unit"].as_str().unwrap())).collect();
    let expected = [
        ("alpha(3)", "rad/s^2"),
        ("v(B)", "cm/s"),
        ("v(B)", "m/s"),
        ("omega(4)", "rpm"),
        ("x(B)", "in"),
        ("x(B)", "cm"),
        ("angle(3)", "deg"),
        ("angle(3)", "rad"),
        ("transmission(3/4)", "deg"),
        ("v(B)", "cm/s"),
    ];
    assert_eq!(heads, expected);
    let vector = |index: usize| -> Vec<f64> {
        list[index]["value"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let near = |a: f64, b: f64| (a - b).abs() <= 1e-14 * b.abs();
    for axis in 0..2 {
        assert!(near(vector(1)[axis], 100.0 * vector(2)[axis]));
        assert!(near(vector(5)[axis], 2.54 * vector(4)[axis]));
        assert_eq!(vector(1)[axis], vector(9)[axis]);
    }
    // 5.84365 rad/s, to six digits, is 55.803 rpm.
    let rpm = list[3]["value"].as_f64().unwrap();
    assert!((rpm - 5.843_65 * 30.0 / std::f64::consts::PI).abs() <= 5e-5);
    assert!(near(list[6]["value"].as_f64().unwrap(), list[7]["value"].as_f64().unwrap().to_degrees()));
}

#[test]
fn the_table_and_the_explanation() {
    let ran = run(&["solve", SIX, "--explain"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    for part in ["n = 6", "omega(4)", "rad/s", "cm/s^2", "analytic", "agree", "kept", "RRP of links 5, 6"] {
        assert!(ran.out.contains(part), "{part}:\n{}", ran.out);
    }
    let mut scene = six();
    scene["find"] = serde_json::json!(["v(B)"]);
    let folder = Folder::new("explain");
    folder.write("s.json", scene.to_string());
    let ran = run_in(&folder.0, &["solve", "s.json", "--explain", "--json"], None);
    let solved: Value = serde_json::from_str(&ran.out).unwrap();
    let lines = solved["explain"].as_array().unwrap();
    let skipped = lines.iter().filter(|l| l.as_str().unwrap().starts_with("skipped")).count();
    assert_eq!(skipped, 5, "{lines:?}");
}

#[test]
fn standard_input_is_a_scene() {
    let text = common::example_text("s000-ch3a-1");
    let from_file = run(&["solve", SIX, "--json"]);
    let from_input = run_in(common::root(), &["solve", "-", "--json"], Some(text.as_bytes()));
    assert_eq!((from_input.code, &from_input.out), (0, &from_file.out));
    let bad = text.replace("\"length\": 45", "\"lenght\": 45");
    let ran = run_in(common::root(), &["solve", "-"], Some(bad.as_bytes()));
    assert_eq!(ran.code, 2);
    let (line, text) = bad.lines().enumerate().find(|(_, l)| l.contains("lenght")).unwrap();
    let at = format!("{}:{}: links.3.lenght: ", line + 1, text.find("\"lenght").unwrap() + 1);
    assert!(ran.err.contains(&at), "{at}: {}", ran.err);
}

// --- refusals ------------------------------------------------------------------------------------------

/// A mistake in problem 3-1, where it must be found, and what must be said.
struct Mistake {
    from: &'static str,
    to: &'static str,
    path: &'static str,
    says: &'static [&'static str],
}

#[test]
fn bad_scenes_get_one_error_with_its_place_and_mend_and_nothing_is_written() {
    let mistakes = [
        Mistake {
            from: r#""length": 45 }"#,
            to: r#""lenght": 45 }"#,
            path: "links.3.lenght",
            says: &["length"],
        },
        Mistake { from: r#""length": 45 }"#, to: r#""length": -45 }"#, path: "links.3.length", says: &[] },
        Mistake { from: r#""length": 45 }"#, to: r#""length": 1e999 }"#, path: "links.3.length", says: &[] },
        Mistake { from: r#""length": 45 }"#, to: r#""length": 0 }"#, path: "links.3.length", says: &[] },
        Mistake { from: r#"["O2", "A"]"#, to: r#"["O2", 7]"#, path: "links.2.joins", says: &[] },
        Mistake { from: r#""omega(5)""#, to: r#""omega(9)""#, path: "find", says: &["9"] },
        Mistake { from: r#""v(D/C)","#, to: r#""v(E/C)","#, path: "find", says: &["E"] },
        Mistake { from: r#""10 rad/s cw""#, to: r#""10 parsec cw""#, path: "input.omega", says: &["parsec"] },
        Mistake { from: r#""pin": "D""#, to: r#""pin": "Q""#, path: "slides[0].pin", says: &["Q", "help"] },
        // No chain: 30 cm and 0.45 cm do not reach from O4 to A, 32.9 cm away.
        Mistake {
            from: r#""length": 45 }"#,
            to: r#""length": 0.45 }"#,
            path: "input",
            says: &["cannot be assembled", "AB"],
        },
        // A freedom is left over; a constraint is too many.
        Mistake {
            from: r#""length": 37 }"#,
            to: r#""length": 37 }, "7": { "joins": ["A", "E"], "length": 10 }"#,
            path: "input",
            says: &["1 degree of freedom left over", "link 7", "n = 7"],
        },
        Mistake {
            from: r#""input": { "link": 2, "angle": 30, "omega": "10 rad/s cw" }"#,
            to: r#""inputs": [{ "link": 2, "angle": 30, "omega": 1 }, { "link": 4, "angle": 80, "omega": 1 }]"#,
            path: "inputs[1]",
            says: &["the input of link 4", "too many"],
        },
        // An unknown key, and a text that is no JSON.
        Mistake { from: r#""angle": 0 }"#, to: r#""angle": 0 } }], "x": [{"#, path: "x", says: &[] },
        Mistake { from: r#", "length": 15 }"#, to: r#", "length": 15"#, path: "", says: &[] },
    ];
    let text = common::example_text("s000-ch3a-1");
    for (index, mistake) in mistakes.iter().enumerate() {
        assert!(text.contains(mistake.from), "{}", mistake.from);
        let bad = text.replacen(mistake.from, mistake.to, 1);
        let folder = Folder::new(&format!("bad-{index}"));
        folder.write("bad.json", &bad);
        folder.write("old.svg", "an older sheet");
        let before = folder.contents();
        for arguments in [
            &["solve", "bad.json"][..],
            &["solve", "bad.json", "--json"],
            &["draw", "bad.json"],
            &["draw", "bad.json", "-o", "new.svg", "-o", "old.svg"],
        ] {
            let ran = run_in(&folder.0, arguments, None);
            assert_eq!(ran.code, 2, "{}: {arguments:?}", mistake.to);
            let (line, column, message) = place(&ran, "bad.json");
            assert!(message.starts_with(mistake.path), "{} is not at {}", ran.err, mistake.path);
            for word in mistake.says {
                assert!(message.contains(word), "{}: no {word}", ran.err);
            }
            // The place is in the file, and for a replaced word on its line.
            let lines: Vec<&str> = bad.lines().collect();
            assert!(
                line <= lines.len() + 1 && column <= lines.get(line - 1).map_or(0, |l| l.chars().count()) + 1,
                "{}",
                ran.err
            );
            assert_eq!(folder.contents(), before, "{arguments:?} wrote something");
        }
    }
}

#[test]
fn the_three_refusals_are_three_errors() {
    let unreachable = run(&["solve", "examples/refusals/s000-ch4-2-150-unreachable.json"]);
    let (_, _, message) = place(&unreachable, "examples/refusals/s000-ch4-2-150-unreachable.json");
    assert!(message.contains("cannot be assembled") && message.contains("720 mm"), "{message}");
    // 300² + 600² − 2·300·600 cos θ = 720² at the edge.
    let edge =
        libm::acos((300.0 * 300.0 + 600.0 * 600.0 - 720.0 * 720.0) / (2.0 * 300.0 * 600.0)).to_degrees();
    assert!(message.contains(&format!("{edge:.4}")), "no edge at {edge}: {message}");

    let ambiguous = run(&["solve", "examples/refusals/s000-ch4-2-30-ambiguous.json"]);
    let (_, _, message) = place(&ambiguous, "examples/refusals/s000-ch4-2-30-ambiguous.json");
    // Both places stand in the case's table.
    assert!(
        message.contains("ambiguous") && message.contains("305.5") && message.contains("554.2"),
        "{message}"
    );
    assert!(message.contains("near"), "{message}");

    let dead = run(&["solve", "examples/refusals/dead-centre.json"]);
    assert!([1, 2].contains(&dead.code));
    let said = format!("{}{}", dead.out, dead.err);
    assert!(said.contains("indeterminate") && said.contains("3") && said.contains("4"), "{said}");
}

#[test]
fn a_quantity_that_is_indeterminate_alone_is_exit_1() {
    // ω of the crank is known in the dead centre, those of coupler and rocker are not.
    let mut scene: Value = serde_json::from_str(
        &std::fs::read_to_string(common::root().join("examples/refusals/dead-centre.json")).unwrap(),
    )
    .unwrap();
    scene["find"] = serde_json::json!(["omega(2)", "omega(3)"]);
    scene.as_object_mut().unwrap().remove("expect");
    let (code, solved) = solve_json(&scene.to_string());
    assert_eq!(code, 1);
    let list = solved["quantities"].as_array().unwrap();
    assert_eq!(list[0]["value"].as_f64(), Some(1.0));
    assert!(list[1]["indeterminate"].as_str().unwrap().contains("dead centre"), "{}", list[1]);
    assert!(list[1].get("value").is_none());
}

#[test]
fn a_sheet_of_what_is_indeterminate_is_written_and_exit_1() {
    let mut scene: Value = serde_json::from_str(
        &std::fs::read_to_string(common::root().join("examples/refusals/dead-centre.json")).unwrap(),
    )
    .unwrap();
    scene["find"] = serde_json::json!(["omega(2)", "omega(3)"]);
    scene.as_object_mut().unwrap().remove("expect");
    let folder = Folder::new("indeterminate-sheet");
    folder.write("dead.json", scene.to_string());
    for kind in ["solution", "question", "steps"] {
        let ran = run_in(&folder.0, &["draw", "dead.json", "--as", kind, "-o", "dead.svg"], None);
        assert_eq!(ran.code, 1, "{kind}: {}", ran.err);
        assert!(ran.err.contains("omega(3)") && ran.err.contains("indeterminate"), "{kind}: {}", ran.err);
        assert!(!ran.err.contains("omega(2)"), "{kind}: {}", ran.err);
        assert!(folder.contents().keys().any(|path| path.ends_with("dead.svg")), "{kind}");
    }
    scene["find"] = serde_json::json!(["omega(2)"]);
    folder.write("dead.json", scene.to_string());
    assert_eq!(run_in(&folder.0, &["draw", "dead.json", "-o", "dead.svg"], None).code, 0);
}

#[test]
fn files_that_are_no_scenes() {
    let folder = Folder::new("no-scenes");
    folder.write("empty.json", "");
    folder.write("bytes.json", b"{ \"title\": \"\xff\xfe\" }");
    folder.write("list.json", "[1, 2]");
    let before = folder.contents();
    for (file, has_place) in
        [("empty.json", true), ("bytes.json", true), ("list.json", true), ("none.json", false), (".", false)]
    {
        let ran = run_in(&folder.0, &["solve", file], None);
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{file}");
        assert!(ran.err.starts_with("error: "), "{}", ran.err);
        assert!(ran.err.contains(file), "{}", ran.err);
        if has_place {
            place(&ran, file);
        }
    }
    assert_eq!(folder.contents(), before);
}

#[test]
fn bad_usage_is_exit_2_on_stderr() {
    for arguments in [
        &[][..],
        &["sovle", SIX],
        &["solve"],
        &["solve", SIX, "--jsno"],
        &["check"],
        &["check", SIX, "--tolerance", "much"],
        &["new", "perpetuum-mobile"],
        &["draw", SIX, "--figure", "velocty"],
        &["draw", SIX, "--lang", "tlh"],
    ] {
        let ran = run(arguments);
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{arguments:?}: {}", ran.err);
        assert!(!ran.err.is_empty());
    }
    let ran = run(&["draw", SIX, "--figure", "velocty"]);
    assert!(ran.err.contains("velocity"), "the nearest name: {}", ran.err);
    for arguments in [&["--help"][..], &["--version"], &["solve", "--help"]] {
        let ran = run(arguments);
        assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}");
        assert!(ran.out.contains("linkgram"));
    }
}

/// Problem 3-1 with each of its lines taken out in turn, and cut off after it.
#[test]
fn scenes_with_missing_lines_are_solved_or_refused_with_a_place() {
    let text = common::example_text("s000-ch3a-1");
    let lines: Vec<&str> = text.lines().collect();
    let mut refused = 0;
    for gone in 0..lines.len() {
        let without: Vec<&str> =
            lines.iter().enumerate().filter(|(i, _)| *i != gone).map(|(_, l)| *l).collect();
        for bad in [without.join("\n"), lines[..gone].join("\n")] {
            let ran = run_in(common::root(), &["solve", "-"], Some(bad.as_bytes()));
            if ran.code == 2 {
                let after_file = ran.err.split_once(':').unwrap().1;
                let digits = |part: &str| part.parse::<usize>().is_ok();
                let numbers = after_file.split(':').filter(|part| digits(part)).count();
                assert!(numbers >= 2, "no place: {}", ran.err);
                refused += 1;
            }
        }
    }
    assert!(refused > lines.len(), "{refused}");
}

// --- draw ----------------------------------------------------------------------------------------------

#[test]
fn drawing_is_the_same_on_stdout_and_in_a_file() {
    let folder = Folder::new("draw");
    let scene = common::root().join(SIX);
    let scene = scene.to_str().unwrap();
    let shown = run_in(&folder.0, &["draw", scene], None);
    assert_eq!((shown.code, shown.err.as_str()), (0, ""));
    assert!(shown.out.contains("<svg") && shown.out.trim_end().ends_with("</svg>"));
    assert!(folder.contents().is_empty());
    let written = run_in(&folder.0, &["draw", scene, "-o", "a.svg", "-o", "b.SVG"], None);
    assert_eq!((written.code, written.out.as_str(), written.err.as_str()), (0, "", ""));
    let contents = folder.contents();
    assert_eq!(contents.len(), 2, "two files and no leftovers: {:?}", contents.keys());
    assert!(contents.values().all(|bytes| bytes == shown.out.as_bytes()));
    let single = run_in(&folder.0, &["draw", scene, "--figure", "velocity"], None);
    assert_eq!(single.code, 0);
    assert!(single.out.contains("<svg") && single.out.len() < shown.out.len());
}

#[test]
fn nothing_is_written_when_one_output_fails() {
    let folder = Folder::new("half");
    let scene = common::root().join(SIX);
    let scene = scene.to_str().unwrap();
    for second in ["sheet.bmp", "sheet", "nowhere/sheet.svg"] {
        let ran = run_in(&folder.0, &["draw", scene, "-o", "sheet.svg", "-o", second], None);
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{second}");
        assert!(ran.err.contains(second.rsplit('/').next().unwrap()), "{}", ran.err);
        assert!(folder.contents().is_empty(), "{second}: {:?}", folder.contents().keys());
    }
}

#[test]
fn the_ending_or_the_option_chooses_the_format() {
    let folder = Folder::new("formats");
    let scene = common::root().join(SIX);
    let scene = scene.to_str().unwrap();
    let written = run_in(&folder.0, &["draw", scene, "-o", "a.tex", "-o", "a.json", "-o", "a.svg"], None);
    assert_eq!((written.code, written.err.as_str()), (0, ""));
    let contents = folder.contents();
    assert_eq!(contents.len(), 3);
    for (ending, starts) in [("tex", "% Problem 3-1"), ("json", "{"), ("svg", "<svg")] {
        let bytes = &contents[&folder.0.join(format!("a.{ending}"))];
        assert!(bytes.starts_with(starts.as_bytes()), "{ending}");
        let shown = run_in(&folder.0, &["draw", scene, "--format", ending], None);
        assert_eq!((shown.code, shown.out.as_bytes()), (0, &bytes[..]), "{ending}");
    }
    for (arguments, says) in [
        (&["--format", "jsn"][..], "json"),
        (&["--format", "svg", "-o", "b.svg"], "ending"),
        (&["--theme", "color"], "colour"),
        (&["--text", "outlined", "-o", "b.svg"], "outline"),
        (&["--text", "outline", "-o", "b.json"], "SVG"),
        (&["-o", "b.bmp"], ".svg, .png, .pdf, .tex, .json or .html"),
    ] {
        let ran = run_in(&folder.0, &[&["draw", scene], arguments].concat(), None);
        assert_eq!(ran.code, 2, "{arguments:?}");
        assert!(ran.err.contains(says), "{arguments:?}: {}", ran.err);
    }
    assert_eq!(folder.contents(), contents, "nothing else was written");
}

#[test]
fn what_latex_cannot_set_is_refused_and_nothing_is_written() {
    let folder = Folder::new("latex");
    let text = common::example_text("s000-ch3a-1").replacen("Problem", "\u{5e9}", 1);
    folder.write("scene.json", &text);
    let ran = run_in(&folder.0, &["draw", "scene.json", "-o", "a.svg", "-o", "a.tex"], None);
    assert_eq!(ran.code, 2);
    assert!(ran.err.contains("U+05E9") && ran.err.contains(".svg, .png or .pdf"), "{}", ran.err);
    assert_eq!(folder.contents().len(), 1);
}

/// Other positions are drawn where they are wished; a question asks for them and shows none.
#[test]
fn other_positions_are_for_the_solution() {
    let text = common::example_text("other-positions");
    let draw = |arguments: &[&str]| {
        let ran = run_in(common::root(), &[&["draw", "-"], arguments].concat(), Some(text.as_bytes()));
        assert_eq!(ran.code, 0, "{}", ran.err);
        ran.out
    };
    let numbers = |svg: &str, of: &str| svg.matches(&format!("data-number=\"{of}\"")).count();
    let all = draw(&[]);
    assert_eq!(["I", "II", "III", "IV", "assembly", "V"].map(|of| numbers(&all, of)), [1, 1, 1, 1, 1, 0]);
    let stated = draw(&["--figure", "skeleton", "--positions", "30,-1 rad,390"]);
    assert_eq!(["I", "II", "III", "IV"].map(|of| numbers(&stated, of)), [1, 1, 1, 0]);
    assert!(!stated.contains("velocity"));
    let question = draw(&["--as", "question"]);
    assert!(!question.contains("other-position") && question.contains("120"), "asked for, not drawn");
    let bad = [
        (["--positions", "60,left"], "--positions: `left` is not"),
        (["--positions", "60,2 mm"], "--positions: `2 mm` is not"),
        (["--positions", "1e6"], "more than 20 turns"),
    ];
    for (arguments, says) in bad {
        let ran = run_in(common::root(), &[&["draw", "-"][..], &arguments].concat(), Some(text.as_bytes()));
        assert!(ran.code == 2 && ran.err.contains(says) && ran.out.is_empty(), "{arguments:?}: {}", ran.err);
    }
    let wrong = text.replace("\"150 deg\"", "\"150 mm\"");
    let ran = run_in(common::root(), &["draw", "-"], Some(wrong.as_bytes()));
    assert!(ran.code == 2 && ran.err.contains("sheet.positions"), "{}", ran.err);
}

#[test]
fn the_scene_states_a_theme_and_the_command_overrides_it() {
    let text =
        common::example_text("s000-ch3a-1").replacen("\"sheet\": {", "\"sheet\": { \"theme\": \"dark\",", 1);
    let draw = |arguments: &[&str]| {
        let all = [&["draw", "-", "--figure", "velocity"], arguments].concat();
        let ran = run_in(common::root(), &all, Some(text.as_bytes()));
        assert_eq!(ran.code, 0, "{}", ran.err);
        ran.out
    };
    assert!(draw(&[]).contains("class=\"paper\""));
    assert!(!draw(&["--theme", "mono"]).contains("class=\"paper\""));
    let bad = text.replace("dark", "drak");
    let ran = run_in(common::root(), &["draw", "-"], Some(bad.as_bytes()));
    assert!(ran.code == 2 && ran.err.contains("did you mean `dark`"), "{}", ran.err);
}

#[test]
fn a_figure_that_nobody_needs_is_refused() {
    let mut scene = six();
    scene["find"] = serde_json::json!(["v(B)"]);
    scene.as_object_mut().unwrap().remove("published");
    let text = scene.to_string();
    let ran = run_in(common::root(), &["draw", "-", "--figure", "acceleration"], Some(text.as_bytes()));
    assert_eq!((ran.code, ran.out.as_str()), (2, ""));
    assert!(ran.err.contains("acceleration"), "{}", ran.err);
}

// --- check, new, schema --------------------------------------------------------------------------------

#[test]
fn the_examples_hold() {
    let ran = run(&["check", "examples"]);
    assert_eq!(ran.code, 0, "{}", ran.out);
    assert_eq!(ran.err, "");
    let count = common::example_paths().len();
    assert!(ran.out.contains(&format!("{count} of {count} scenes hold")), "{}", ran.out);
    assert!(!ran.out.contains("FAILS"));
}

#[test]
fn check_json_tells_scenes_in_order_with_their_percentages() {
    let ran = run(&["check", "examples", "--json"]);
    assert_eq!(ran.code, 0);
    let checked: Value = serde_json::from_str(&ran.out).unwrap();
    let scenes = checked["scenes"].as_array().unwrap();
    assert_eq!(scenes.len(), common::example_paths().len());
    let names: Vec<&str> = scenes.iter().map(|s| s["scene"].as_str().unwrap()).collect();
    let mut sorted = names.clone();
    sorted.sort_by(|a, b| Path::new(a).cmp(Path::new(b)));
    assert_eq!(names, sorted);
    for scene in scenes {
        assert_eq!(scene["ok"], true, "{scene}");
        for published in scene["published"].as_array().into_iter().flatten() {
            for key in ["name", "published", "computed", "percent", "ok"] {
                assert!(published.get(key).is_some(), "{key}: {published}");
            }
        }
    }
    // Problem 3-1: the case's own percentages (ω₄ −3.1, α₅ −8.8), to their one decimal.
    let six = scenes.iter().find(|s| s["scene"].as_str().unwrap().ends_with("s000-ch3a-1.json")).unwrap();
    assert!(six["agreement"]["worst_ratio"].as_f64().unwrap() <= 1.0);
    for (name, percent) in [("omega(4)", -3.1), ("v(B)", -3.0), ("a(D)", 1.2), ("alpha(5)", -8.8)] {
        let published = six["published"].as_array().unwrap();
        let found = published.iter().find(|p| p["name"] == name).unwrap()["percent"].as_f64().unwrap();
        assert!((found - percent).abs() <= 0.051, "{name}: {found} %");
    }
}

#[test]
fn a_scene_holds_when_exactly_its_errata_miss() {
    let folder = Folder::new("errata");
    let text = std::fs::read_to_string(common::root().join("examples/errata/s002-3.json")).unwrap();
    let mut scene: Value = serde_json::from_str(&text).unwrap();
    let errata = scene["errata"].clone();
    assert!(!errata.as_array().unwrap().is_empty());
    let mut exit = |errata: Value, expect: Option<&str>| {
        scene["errata"] = errata;
        if let Some(expect) = expect {
            scene["expect"] = Value::from(expect);
        }
        folder.write("s.json", scene.to_string());
        run_in(&folder.0, &["check", "s.json"], None).code
    };
    assert_eq!(exit(errata.clone(), None), 0);
    // An error that the scene does not know, and one that is none.
    assert_eq!(exit(serde_json::json!([]), None), 1);
    let mut more = errata.as_array().unwrap().clone();
    more.push(Value::from("v(A)"));
    assert_eq!(exit(Value::from(more), None), 1);
    // A refusal that does not come.
    assert_eq!(exit(errata, Some("cannot-assemble")), 1);
}

#[test]
fn a_refusal_that_nobody_expects_does_not_hold() {
    let folder = Folder::new("refusal");
    let path = common::root().join("examples/refusals/s000-ch4-2-150-unreachable.json");
    let text = std::fs::read_to_string(path).unwrap();
    folder.write("right.json", &text);
    folder.write("wrong.json", text.replace("\"cannot-assemble\"", "\"ambiguous\""));
    let mut scene: Value = serde_json::from_str(&text).unwrap();
    scene.as_object_mut().unwrap().remove("expect");
    folder.write("none.json", scene.to_string());
    let codes =
        ["right.json", "wrong.json", "none.json"].map(|f| run_in(&folder.0, &["check", f], None).code);
    assert_eq!(codes, [0, 1, 1]);
    // A broken file is bad input, and the others are still told.
    folder.write("zz.json", "{");
    let ran = run_in(&folder.0, &["check", "."], None);
    assert_eq!(ran.code, 2);
    assert!(ran.out.contains("right.json") && ran.err.contains("zz.json:1:"), "{}\n{}", ran.out, ran.err);
}

#[test]
fn the_tolerance_is_for_what_states_none() {
    let folder = Folder::new("tolerance");
    let mut scene = six();
    scene["published"] = serde_json::json!({ "v(B)": "170 cm/s" });
    folder.write("s.json", scene.to_string());
    // The print is 3.0 % low.
    let codes = ["5%", "3.1%", "2.9%", "0.029"]
        .map(|t| run_in(&folder.0, &["check", "s.json", "--tolerance", t], None).code);
    assert_eq!(codes, [0, 0, 1, 1]);
}

#[test]
fn every_kind_of_the_catalogue_is_a_scene_that_solves() {
    let list = run(&["new"]);
    assert_eq!(list.code, 0);
    let kinds: Vec<&str> = list.out.lines().filter_map(|l| l.split_whitespace().next()).collect();
    let known: Vec<&str> = kinds.into_iter().filter(|k| run(&["new", k]).code == 0).collect();
    for kind in ["four-bar", "four-bar-crossed", "slider-crank", "slider-crank-offset", "six-link"] {
        assert!(known.contains(&kind), "{kind}: {}", list.out);
    }
    assert!(known.len() >= 10, "{known:?}");
    for kind in known {
        let scene = run(&["new", kind]).out;
        let (code, solved) = solve_json(&scene);
        assert_eq!((code, &solved["agreement"]["ok"]), (0, &Value::Bool(true)), "{kind}");
    }
}

#[test]
fn the_schema_is_json_and_names_every_key() {
    let ran = run(&["schema"]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let schema: Value = serde_json::from_str(&ran.out).unwrap();
    let properties = schema["properties"].as_object().unwrap();
    for key in [
        "title",
        "units",
        "fixed",
        "placed",
        "near",
        "links",
        "slides",
        "rolls",
        "input",
        "inputs",
        "find",
        "pins",
        "published",
        "errata",
        "expect",
        "sheet",
    ] {
        assert!(properties.contains_key(key), "{key}");
    }
}

// --- arithmetic, hand, sweeps --------------------------------------------------------------------------

#[test]
fn the_arithmetic_is_the_users_choice() {
    let path = SIX;
    let bound = |arith: &str| {
        let ran = run(&["solve", path, "--json", "--arith", arith]);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let solved: Value = serde_json::from_str(&ran.out).unwrap();
        assert_eq!(solved["agreement"]["ok"], true);
        let q = solved["quantities"]
            .as_array()
            .unwrap()
            .iter()
            .find(|q| q["name"] == "omega(4)")
            .cloned()
            .unwrap();
        (q["bound"].as_f64().unwrap(), q)
    };
    let (single, _) = bound("f32");
    let (double, plain) = bound("f64");
    let (fine, q) = bound("dd");
    assert!(single > 1e6 * double && double > fine && plain.get("digits").is_none());
    // More digits than a double has; the double is their beginning.
    assert!(q["digits"].as_str().unwrap().len() > 25 && q["digits_bound"].as_f64().unwrap() < 1e-24);
    assert!(q["digits"].as_str().unwrap().starts_with("5.84365081"));
    let ran = run(&["solve", path, "--arith", "f16"]);
    assert!(ran.code == 2 && ran.err.contains("f32, f64 or dd"), "{}", ran.err);
}

#[test]
fn a_hand_of_pencil_and_ruler() {
    let path = SIX;
    let ran = run(&["solve", path, "--json", "--hand", "0.2mm,0.3deg"]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let solved: Value = serde_json::from_str(&ran.out).unwrap();
    for q in solved["quantities"].as_array().unwrap() {
        let number = |key: &str| q["hand"][key].as_f64().unwrap();
        assert!(number("median") <= number("most") && number("most") <= number("largest"), "{q}");
        assert!(number("largest") <= 1.1 * number("worst"), "{q}");
    }
    assert!(run(&["solve", path, "--hand", "0.2mm,0.3deg"]).out.contains("by hand ±"));
    for wrong in ["0.2", "0.2mm", "a,b", "-1,0.3", "0.2,400"] {
        let ran = run(&["solve", path, &format!("--hand={wrong}")]);
        assert!(ran.code == 2 && ran.out.is_empty(), "{wrong}: {}", ran.err);
    }
}

#[test]
fn a_sweep_tells_what_happens_and_writes_tables() {
    let folder = Folder::new("sweep");
    let scene = std::path::absolute(Path::new(env!("CARGO_MANIFEST_DIR")).join(SIX)).unwrap();
    let path = scene.to_str().unwrap();
    let ran = run(&["sweep", path]);
    assert_eq!(ran.code, 0, "{}", ran.err);
    assert!(ran.out.contains("moves from") && ran.out.contains("operations for one position"), "{}", ran.out);
    let ran = run_in(
        &folder.0,
        &["sweep", path, "--steps", "12", "-o", "a.csv", "-o", "a.json", "-o", "a.svg"],
        None,
    );
    assert_eq!(ran.code, 0, "{}", ran.err);
    let contents = folder.contents();
    let text = |name: &str| String::from_utf8(contents[&folder.0.join(name)].clone()).unwrap();
    let csv = text("a.csv");
    let columns = csv.lines().next().unwrap().split(',').count();
    assert!(csv.lines().all(|line| line.split(',').count() == columns), "{csv}");
    assert!(!csv.contains("NaN") && !csv.contains("inf"));
    let json: Value = serde_json::from_str(&text("a.json")).unwrap();
    assert_eq!(json["positions"].as_array().unwrap().len() + 1, csv.lines().count());
    assert_eq!(json["columns"].as_array().unwrap().len() + 1, columns);
    assert!(text("a.svg").starts_with("<svg"));
    for wrong in [
        &["sweep", path, "-o", "a.txt"][..],
        &["sweep", path, "--from", "10"],
        &["sweep", path, "--steps", "0"],
        &["sweep", path, "--steps", "10", "--tolerance", "1%"],
        &["sweep", path, "--from", "100", "--to", "50"],
    ] {
        let ran = run_in(&folder.0, wrong, None);
        assert!(ran.code == 2 && ran.out.is_empty() && !ran.err.is_empty(), "{wrong:?}: {}", ran.err);
    }
    assert_eq!(folder.contents(), contents, "a refused sweep writes nothing");
}

/// A piece of a curve whose handle is far longer than itself shoots out of the diagram: these have kinks of magnitudes and
/// corners of hodographs beside their places.
#[test]
fn no_curve_of_a_sweep_has_a_spike() {
    let folder = Folder::new("sweep-spikes");
    let mut looked = 0;
    for example in ["s000-ch3a-2", "s000-ch4-8-d", "s000-ch4-9-d", "s000-ch4-6-c"] {
        let scene =
            Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(example).with_extension("json");
        let scene = std::path::absolute(scene).unwrap();
        let ran =
            run_in(&folder.0, &["sweep", scene.to_str().unwrap(), "--steps", "72", "-o", "s.svg"], None);
        assert_eq!(ran.code, 0, "{}", ran.err);
        let svg = std::fs::read_to_string(folder.0.join("s.svg")).unwrap();
        std::fs::remove_file(folder.0.join("s.svg")).unwrap();
        let document = roxmltree::Document::parse(&svg).unwrap();
        let curves = document.descendants().filter(|node| {
            node.attribute("class").is_some_and(|class| class.split(' ').any(|own| own == "curve"))
        });
        for curve in curves.filter_map(|node| node.attribute("d")) {
            looked += 1;
            for piece in kurbo::BezPath::from_svg(curve).unwrap().segments() {
                let kurbo::PathSeg::Cubic(cubic) = piece else { continue };
                let handle = cubic.p0.distance(cubic.p1).max(cubic.p2.distance(cubic.p3));
                let chord = cubic.p0.distance(cubic.p3);
                assert!(handle <= 1.5 * chord + 0.5, "{example}: a handle of {handle} mm bends {chord} mm");
            }
        }
    }
    assert!(looked > 20, "{looked} curves");
}

/// The rows of a table of a sweep, by heading.
fn table(csv: &str) -> (Vec<String>, Vec<Vec<Option<f64>>>) {
    let mut lines = csv.lines();
    let heads = lines.next().unwrap().split(',').map(str::to_owned).collect();
    let number = |text: &str| (!text.is_empty()).then(|| text.parse::<f64>().unwrap());
    (heads, lines.map(|line| line.split(',').map(number).collect()).collect())
}

#[test]
fn a_sweep_goes_over_time_with_bounds_and_in_every_language() {
    let folder = Folder::new("sweep-time");
    folder.write("s.json", six().to_string());
    let files = ["-o", "a.csv", "-o", "a.json", "-o", "a.svg", "-o", "a.tex"];
    let arguments = ["sweep", "s.json", "--against", "time", "--bounds", "--steps", "8", "--lang", "ar"];
    let ran = run_in(&folder.0, &[&arguments[..], &files[..]].concat(), None);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let contents = folder.contents();
    let text = |name: &str| String::from_utf8(contents[&folder.0.join(name)].clone()).unwrap();
    let (heads, rows) = table(&text("a.csv"));
    assert!(heads[0] == "time [s]" && heads[2].starts_with("bound of "), "{heads:?}");
    assert_eq!(rows.len(), 9);
    let json: Value = serde_json::from_str(&text("a.json")).unwrap();
    for (row, position) in rows.iter().zip(json["positions"].as_array().unwrap()) {
        // Both tables read back to the same doubles.
        assert_eq!(row[0], position["at"].as_f64());
        for (c, pair) in row[1..].chunks(2).enumerate() {
            assert_eq!(pair[0], position["values"][c].as_f64(), "{}", heads[1 + 2 * c]);
            assert_eq!(pair[1], position["bounds"][c].as_f64(), "{}", heads[2 + 2 * c]);
            assert!(pair[1].unwrap() < 1e-9);
        }
    }
    // At the beginning it is the scene itself: what `solve` says.
    let ran = run_in(&folder.0, &["solve", "s.json", "--json"], None);
    let solved: Value = serde_json::from_str(&ran.out).unwrap();
    let mut compared = 0;
    for q in solved["quantities"].as_array().unwrap() {
        let name = q["name"].as_str().unwrap();
        for (suffix, value) in
            [("", &q["value"]), (".x", &q["value"][0]), (".y", &q["value"][1])].map(|(s, v)| (s, v.as_f64()))
        {
            let head = format!("{name}{suffix} [");
            let column = heads.iter().position(|h| h.starts_with(&head));
            if let (Some(column), Some(value)) = (column, value) {
                let apart = (rows[0][column].unwrap() - value).abs();
                let bound = q["bound"].as_f64().unwrap() + rows[0][column + 1].unwrap();
                assert!(apart <= bound, "{name}{suffix}: {apart:e} {bound:e}");
                compared += 1;
            }
        }
    }
    assert!(compared > 5, "{compared} of {heads:?}");
    let svg = text("a.svg");
    assert!(svg.contains("xml:lang=\"ar\"") || svg.contains("lang=\"ar\""), "{}", &svg[..400]);
    assert!(!svg.contains("Hodograph") && !svg.contains("NaN"));
    // Without a file the table follows what happens.
    let ran = run_in(&folder.0, &["sweep", "s.json", "--steps", "2"], None);
    assert!(ran.code == 0 && ran.out.contains("\n\nangle of link 2 [deg],"), "{}", ran.out);
}

#[test]
fn what_cannot_be_swept_is_told_with_nothing_written() {
    let folder = Folder::new("sweep-refused");
    folder.write("s.json", six().to_string());
    let mut still = six();
    still["input"]["omega"] = serde_json::json!(0);
    folder.write("still.json", still.to_string());
    let contents = folder.contents();
    for (wrong, told) in [
        (&["sweep", "s.json", "-o", "none/a.csv"][..], "none/a.csv"),
        (&["sweep", "s.json", "-o", "a.csv", "-o", "none/a.svg"], "none/a.svg"),
        (&["sweep", "s.json", "-o", "a.csv", "-o", "a.csv"], "twice"),
        (&["sweep", "s.json", "--tolerance", "0", "-o", "a.csv"], "tolerance"),
        (&["sweep", "s.json", "--tolerance", "-1", "-o", "a.csv"], "tolerance"),
        (&["sweep", "s.json", "--tolerance", "1e-300", "-o", "a.csv"], "least tolerance"),
        (&["sweep", "s.json", "--steps", "99999999999", "-o", "a.csv"], "--steps"),
        (&["sweep", "s.json", "--steps", "1000001", "-o", "a.csv"], "1000000"),
        (&["sweep", "s.json", "--lang", "xx", "-o", "a.svg"], "language xx"),
        (&["sweep", "s.json", "--bounds", "-o", "a.svg"], "--bounds is for tables"),
        (&["sweep", "s.json", "--against", "angle"], "--against"),
        (&["sweep", "s.json", "--from", "0", "--to", "1e9"], "more than 100 times"),
        (&["sweep", "s.json", "--from", "100", "--to", "120"], "own position must lie in the range"),
        (&["sweep", "s.json", "--against", "time", "--from", "1", "--to", "2"], "own instant"),
        (&["sweep", "still.json", "--against", "time"], "nothing moves"),
    ] {
        let ran = run_in(&folder.0, wrong, None);
        assert!(ran.code == 2 && ran.out.is_empty() && ran.err.contains(told), "{wrong:?}: {}", ran.err);
        assert_eq!(folder.contents(), contents, "{wrong:?}");
    }
    let ran = run_in(&folder.0, &["sweep", "s.json", "--steps", "1", "-o", "b.csv"], None);
    let rows = table(&String::from_utf8(folder.contents()[&folder.0.join("b.csv")].clone()).unwrap()).1;
    assert!(ran.code == 0 && rows.len() == 2 && rows[1][0] == Some(360.0), "{rows:?}");
}

// --- what hostile hands find ---------------------------------------------------------------------------

/// The figure as JSON, and the table of a sweep, end in `.json` as the scene does.
#[test]
fn a_scene_is_never_written_over() {
    let folder = Folder::new("spare");
    folder.write("s.json", six().to_string());
    let before = folder.contents();
    for command in ["draw", "sweep"] {
        for output in ["s.json", "./s.json", "../../../../../../..//S"] {
            let output = output.replace("S", folder.0.join("s.json").to_str().unwrap());
            let ran = run_in(&folder.0, &[command, "s.json", "-o", &output], None);
            assert!(ran.code == 2 && ran.err.contains("is the scene itself"), "{output}: {}", ran.err);
            assert_eq!(folder.contents(), before);
        }
    }
}

#[test]
fn a_number_that_no_walk_reaches_is_refused_at_once() {
    let ran = run(&["draw", SIX, "--figure", "rotation-centre(1e308)"]);
    assert!(ran.code == 2 && ran.err.contains("within 100 turns"), "{}", ran.err);
    for wrong in [
        &["sweep", SIX, "--from", "nan", "--to", "1"][..],
        &["sweep", SIX, "--from", "0", "--to", "inf"],
        &["draw", SIX, "--dpi", "-5"],
        &["draw", SIX, "--dpi", "300"],
        &["draw", SIX, "--dpi", "300", "--format", "pdf"],
        &["solve", SIX, "--hand", "-1,0"],
        &["check", SIX, "--tolerance", "-1"],
    ] {
        let ran = run(wrong);
        assert!(ran.code == 2 && !ran.err.contains("tip:"), "{wrong:?}: {}", ran.err);
    }
}

/// A film is for browsers, which lack the typefaces: they are in it, unless something else is asked.
#[test]
fn a_film_brings_its_typefaces() {
    let faces = |more: &[&str]| {
        let film = run(&[&["draw", SIX, "--as", "steps", "--play"], more].concat());
        assert_eq!(film.code, 0, "{}", film.err);
        film.out.contains("@font-face")
    };
    assert!(faces(&[]) && !faces(&["--text", "live"]));
}

#[cfg(unix)]
#[test]
fn a_folder_that_links_to_itself_is_walked_once() {
    let folder = Folder::new("loop");
    folder.write("s.json", six().to_string());
    std::os::unix::fs::symlink(".", folder.0.join("again")).unwrap();
    let ran = run_in(&folder.0, &["check", "."], None);
    assert!(ran.code == 0 && ran.out.ends_with("1 of 1 scenes hold\n"), "{}", ran.out);
}

#[test]
fn a_tradeoff_tells_error_and_time_of_every_setting() {
    let folder = Folder::new("tradeoff");
    let path = common::root().join("examples/s000-ch3a-1.json");
    let path = path.to_str().unwrap();
    let ran = run_in(&folder.0, &["tradeoff", path, "--passes", "1", "--json", "-o", "t.svg"], None);
    assert_eq!(ran.code, 0, "{}", ran.err);
    let told: Value = serde_json::from_str(&ran.out).unwrap();
    let settings = told["settings"].as_array().unwrap();
    let of = |name: &str| settings.iter().find(|s| s["setting"] == name).unwrap();
    // The order of the arithmetics' roundoffs, and of a line between two rows of a table: a tenth of the step is
    // a hundredth of the error.
    let error = |name: &str| of(name)["error"]["greatest"].as_f64().unwrap();
    assert!((1e-9..1e-5).contains(&error("drawn, f32, recorded")));
    assert!((1e-17..1e-14).contains(&error("drawn, f64, recorded")));
    assert!((1e-33..1e-29).contains(&error("drawn, dd, recorded")));
    let ratio = error("sweep, 36 steps") / error("sweep, 360 steps");
    assert!((80.0..125.0).contains(&ratio), "{ratio}");
    assert!(error("hand, 0.5 mm 1.0\u{b0}") > error("hand, 0.05 mm 0.1\u{b0}"));
    assert!(error("analytic, Newton to 1e-3") > error("analytic, to rounding"));
    for setting in settings {
        assert_eq!(setting["beyond_bound"], 0, "{setting}");
        assert_eq!(setting["no_answer"], 0, "{setting}");
        assert!(setting["seconds"]["median"].as_f64().unwrap() > 0.0, "{setting}");
    }
    let svg = std::fs::read_to_string(folder.0.join("t.svg")).unwrap();
    assert!(svg.contains("data-name=\"drawn, dd, recorded\""));

    let before = folder.contents();
    let bad = run_in(&folder.0, &["tradeoff", path, "-o", "t.csv"], None);
    assert_eq!((bad.code, bad.out.as_str()), (2, ""), "{}", bad.err);
    let refused = common::root().join("examples/refusals");
    let none = run_in(&folder.0, &["tradeoff", refused.to_str().unwrap(), "-o", "u.svg"], None);
    assert_eq!((none.code, none.out.as_str()), (2, ""), "{}", none.err);
    assert_eq!(folder.contents(), before);
}

/// A parallelogram of awkward numbers: arithmetic finds its coupler's ω to a rounding, and nobody is told of it.
#[test]
fn what_the_bound_cannot_tell_from_zero_has_no_digits_and_no_sense() {
    let folder = Folder::new("noise");
    folder.write(
        "s.json",
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0.1, 0.7], "O4": [70.3, 20.9] },
        "links": { "2": { "joins": ["O2", "A"], "length": 31.7 }, "4": { "joins": ["O4", "B"], "length": 31.7 },
            "3": { "joins": ["A", "B"], "shape": { "A": [0, 0], "B": [70.2, 20.2] } } },
        "near": { "B": [92.8, 43.3] }, "input": { "link": 2, "angle": 45.3, "omega": 7.3, "alpha": -1.9 },
        "find": ["omega(3)", "alpha(3)", "v(B/A)", "omega(4)"] }"#,
    );
    let ran = run_in(&folder.0, &["solve", "s.json"], None);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{}", ran.out);
    let row = |name: &str| -> Vec<String> {
        let line =
            ran.out.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{}", ran.out));
        line.split_whitespace().map(str::to_owned).collect()
    };
    for (name, unit) in [("omega(3)", "rad/s"), ("alpha(3)", "rad/s^2"), ("v(B/A)", "mm/s")] {
        assert_eq!(row(name)[1..4], ["0", unit, "0"], "{}", ran.out);
    }
    assert_eq!(row("omega(4)")[1..4], ["7.3", "rad/s", "ccw"], "{}", ran.out);
    let ran = run_in(&folder.0, &["solve", "s.json", "--json"], None);
    let solved: Value = serde_json::from_str(&ran.out).unwrap();
    for quantity in &solved["quantities"].as_array().unwrap()[..3] {
        assert!(quantity.get("sense").is_none() && quantity.get("direction_deg").is_none(), "{quantity}");
        assert!(quantity.get("value").is_some() && quantity.get("bound").is_some(), "{quantity}");
    }
}

#[test]
fn the_table_of_every_example_fits_a_terminal() {
    for path in common::example_paths() {
        let ran = run(&["solve", path.to_str().unwrap(), "--hand", "0.2mm,0.3deg"]);
        for line in ran.out.lines() {
            assert!(line.chars().count() <= 100, "{}: {line}", path.display());
        }
    }
}
