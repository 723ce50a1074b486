//! A field of a hand-in that nobody understands costs its own mark and no other: it is told with its place and its mend.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::grade::{GradeError, GradeSettings, Report, Verdict, grade, read_answers};
use linkgram::scene::{self, Scene};

/// Crank 30 cm upright, rod 50 cm, 10 rad/s counter-clockwise: the rod only translates. V_B = 300 cm/s to the left, A_B is
/// 2250 cm/s² to the right, ε of the rod is 3000/40 rad/s².
const SCENE: &str = r#"{
    "units": { "length": "cm" },
    "fixed": { "O2": [0, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
    "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
    "near": { "B": [40, 0] },
    "input": { "link": 2, "angle": 90, "omega": "10 rad/s ccw" },
    "find": ["v(B)", "a(B)", "alpha(3)"],
    "sheet": { "marks": { "alpha(3)": 3 } }
}"#;

fn slider_crank() -> Scene {
    scene::read(SCENE, "slider.json").unwrap()
}

fn graded(text: &str) -> Report {
    let scene = slider_crank();
    let answers = read_answers(text, &scene).unwrap_or_else(|why| panic!("{text}: {why}"));
    grade(&scene, &answers, &GradeSettings::default()).unwrap_or_else(|why| panic!("{text}: {why}"))
}

/// What was not read: names, and what is said of each.
fn unread(report: &Report) -> Vec<(&str, String)> {
    report.not_read.iter().map(|one| (one.name.as_str(), one.why.to_string())).collect()
}

/// Whether all that was read is right.
fn rest_is_right(report: &Report) -> bool {
    !report.quantities.is_empty() && report.quantities.iter().all(|one| one.verdict == Verdict::Right)
}

#[test]
fn one_value_that_is_not_understood_costs_its_own_mark() {
    let fields = [
        (r#""75 furlong/s^2""#, "`furlong` is not a unit"),
        (r#""-""#, "does not begin with a number"),
        (r#""seventy-five""#, "does not begin with a number"),
        (r#""75 cm/s""#, "measures a velocity"),
        ("true", "expected"),
        (r#"{ "value": 75, "sense": "left" }"#, "`left` is no sense"),
        (r#"{ "value": "-", "sense": "ccw" }"#, "does not begin with a number"),
        (r#"{ "valeu": 75 }"#, "did you mean `value`?"),
        (r#"{ "value": 75, "value": 70 }"#, "`value` is given twice"),
        (r#""7,5 rad/s^2""#, "decimal comma"),
        (r#"{ "magnitude": -75 }"#, "a magnitude is not negative"),
        ("[75, 1]", "is a number, not a vector"),
    ];
    for (field, what) in fields {
        let text =
            format!("{{\n\"values\": {{ \"v(B)\": 300, \"a(B)\": [2250, 0],\n\"alpha(3)\": {field} }} }}");
        let report = graded(&text);
        let told = unread(&report);
        assert_eq!(told.len(), 1, "{field}: {told:?}");
        assert_eq!(told[0].0, "alpha(3)");
        assert!(told[0].1.starts_with("answers:3:") && told[0].1.contains("values.alpha(3)"), "{told:?}");
        assert!(told[0].1.contains(what), "{field}: {told:?}");
        assert!(rest_is_right(&report), "{field}: {}", report.to_text());
        assert_eq!(report.sum(), (2.0, 5.0), "{field}: {}", report.to_text());
        // It was answered, and is not told to be missing; every form of the report says what became of it.
        assert!(report.missing.is_empty());
        assert!(report.to_text().contains("not read, no marks: "), "{}", report.to_text());
        assert!(report.to_html("Slider-crank", None).contains("class=\"unread\""));
        let json = report.to_json();
        assert_eq!(
            (json["not_read"][0]["line"].as_u64(), json["not_read"].as_array().unwrap().len()),
            (Some(3), 1)
        );
        assert_eq!(json["not_read"][0]["marks"]["of"].as_f64(), Some(3.0));
    }
}

#[test]
fn what_is_not_known_by_its_name_costs_nothing_else() {
    let text = r#"{ "values": { "v(B)": 300, "v(Q)": 3, "a(B)": [2250, 0], "alpha(3)": "75 rad/s^2 ccw" }, "vlaues": {} }"#;
    let report = graded(text);
    assert_eq!(unread(&report).iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["v(Q)", "vlaues"]);
    assert!(rest_is_right(&report));
    assert_eq!(report.sum(), (5.0, 5.0), "{}", report.to_text());
}

#[test]
fn of_two_answers_to_one_question_neither_is_read() {
    for text in [
        r#"{ "values": { "v(B)": 300, "v( B )": 200, "alpha(3)": "75 rad/s^2 ccw" } }"#,
        r#"{ "values": { "v(B)": 300, "v(B)": 200, "alpha(3)": "75 rad/s^2 ccw" } }"#,
        "quantity,value,unit,sense\nv(B),300,cm/s,\nv(B),200,cm/s,\nalpha(3),75,rad/s^2,ccw\n",
    ] {
        let report = graded(text);
        let told = unread(&report);
        assert_eq!(told.len(), 2, "{told:?}");
        assert!(told.iter().all(|(_, why)| why.contains("answered twice")), "{told:?}");
        assert_eq!(report.sum(), (3.0, 5.0), "{}", report.to_text());
    }
}

#[test]
fn a_row_of_a_table_that_is_not_understood_costs_its_own_mark() {
    let rows = [
        ("alpha(3),-,rad/s^2,ccw,", "does not begin with a number"),
        ("alpha(3),75,furlong,ccw,", "`furlong` is not a unit"),
        ("alpha(3),75,rad/s^2,left,", "`left` is no sense"),
        ("alpha(3),75,rad/s^2,ccw,30", "has no direction"),
        ("alpha(3),\"75,rad/s^2,ccw,", "a quotation mark is not closed"),
        ("alpha(3),75,rad/s^2,ccw,,,7", "more fields than the header has"),
        ("alpha(3),,rad/s^2,ccw,", "has no `value`"),
    ];
    for (row, what) in rows {
        let text =
            format!("quantity,value,unit,sense,direction\nv(B),300,cm/s,,180\n{row}\na(B),2250,cm/s^2,,0\n");
        let report = graded(&text);
        let told = unread(&report);
        assert_eq!(told.len(), 1, "{row}: {told:?}");
        assert!(told[0].0 == "alpha(3)" && told[0].1.starts_with("answers:3:"), "{row}: {told:?}");
        assert!(told[0].1.contains(what), "{row}: {told:?}");
        assert!(rest_is_right(&report), "{row}: {}", report.to_text());
        assert_eq!(report.sum(), (2.0, 5.0), "{row}: {}", report.to_text());
    }
}

/// Of what depends on a field that is not understood nothing is guessed.
#[test]
fn numbers_without_a_unit_are_not_read_where_the_units_are_not_understood() {
    let report = graded(
        r#"{ "units": { "length": "parsec" }, "values": { "v(B)": "3 m/s", "a(B)": [2250, 0], "alpha(3)": "75 rad/s^2 ccw" } }"#,
    );
    let told = unread(&report);
    assert_eq!(told.iter().map(|(name, _)| *name).collect::<Vec<_>>(), ["units", "a(B)"], "{told:?}");
    assert_eq!(report.sum(), (4.0, 5.0), "{}", report.to_text());
}

#[test]
fn what_was_measured_by_a_scale_that_is_not_understood_is_not_read() {
    let scales =
        [r#""velocity": "5 per""#, r#""velocty": "10 cm/s per mm""#, r#""velocity": "1e-60 mm/s per mm""#];
    for scale in scales {
        let report = graded(&format!(
            r#"{{ "scales": {{ {scale}, "acceleration": "50 cm/s^2 per mm" }}, "lengths": {{ "v(B)": 60, "a(B)": 45 }},
                "points": {{ "velocity": {{ "o": [0, 0], "b": [-60, 0] }} }}, "values": {{ "alpha(3)": "75 rad/s^2 ccw" }} }}"#
        ));
        let told = unread(&report);
        let names: Vec<&str> = told.iter().map(|(name, _)| *name).collect();
        assert!(names[0].starts_with("scales.velo") && names.contains(&"v(B)"), "{told:?}");
        assert!(names.contains(&"points.velocity") && names.len() == 3, "{told:?}");
        assert!(rest_is_right(&report), "{}", report.to_text());
        assert_eq!(report.sum(), (4.0, 5.0), "{}", report.to_text());
    }
}

#[test]
fn points_that_are_not_understood_leave_the_others_and_the_values() {
    let with = |points: &str| {
        graded(&format!(
            r#"{{ "scales": {{ "velocity": "5 cm/s per mm" }}, "points": {{ "velocity": {{ {points} }} }},
                "values": {{ "a(B)": [2250, 0], "alpha(3)": "75 rad/s^2 ccw" }} }}"#
        ))
    };
    for (points, name, what, marks) in [
        (r#""o": [0, 0], "b": [-60, 0], "q": [1, 2]"#, "velocity:q", "has no point `q`", 5.0),
        (r#""o": [0, 0], "a": [-60, 0], "b": ["-", 0]"#, "velocity:b", "expected a coordinate", 4.0),
        (
            r#""o": [0, 0], "a": [-60, 0], "b": [-60, 0], "b": [60, 0]"#,
            "velocity:b",
            "`b` is given twice",
            4.0,
        ),
        (r#""b": [-60, 0]"#, "points.velocity", "the pole is missing", 4.0),
    ] {
        let report = with(points);
        let told = unread(&report);
        assert!(told.iter().all(|(own, why)| *own == name && why.contains(what)), "{points}: {told:?}");
        assert!(!told.is_empty() && rest_is_right(&report), "{points}: {}", report.to_text());
        assert_eq!(report.sum(), (marks, 5.0), "{points}: {}", report.to_text());
    }
}

/// A text that is no hand-in at all stays refused, and so does one of which nothing is understood.
#[test]
fn what_is_not_understood_at_all_is_refused() {
    let scene = slider_crank();
    for text in ["{", r#"{ "values": { "v(B)": 300 } "#, "v(B) = 300", r#"{ "values": { "v(B)": "-" } }"#] {
        assert!(read_answers(text, &scene).is_err(), "{text}");
    }
    let alone = r#"{ "points": { "velocity": { "b": [1, 2] } } }"#;
    let refused = grade(&scene, &read_answers(alone, &scene).unwrap(), &GradeSettings::default());
    assert!(matches!(refused, Err(GradeError::Answers(why)) if why.what.contains("the pole is missing")));
}

/// Bad input ends with exit status 2, behind the report of all that was understood.
#[test]
fn the_command_grades_the_rest_and_says_what_it_did_not_read() {
    let folder = std::env::temp_dir().join(format!("linkgram-unread-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let read = |name: &str| std::fs::read_to_string(folder.join(name)).unwrap();
    write("scene.json", SCENE);
    write("ada.json", r#"{ "student": "Ada", "values": { "v(B)": 300, "alpha(3)": "75 furlong" } }"#);
    write("bob.json", r#"{ "student": "Bob", "values": { "v(B)": 300 }, "drawing": "bob.svg" }"#);
    write("cy.json", r#"{ "student": "Cy", "values": { "v(B)": 300 } }"#);
    let run = |arguments: &[&str]| {
        let program = env!("CARGO_BIN_EXE_linkgram");
        let ran = std::process::Command::new(program).args(arguments).current_dir(&folder).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (ran.status.code(), text(ran.stdout), text(ran.stderr))
    };
    let (code, out, err) = run(&["grade", "scene.json", "ada.json", "-o", "ada.html"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(out.contains("marks: 1 of 5") && out.contains("not read, no marks: α₃"), "{out}");
    assert!(err.contains("ada.json:1:") && err.contains("values.alpha(3): `furlong` is not a unit"), "{err}");
    assert!(read("ada.html").contains("not read"));
    // A drawing that is not there is one field that cannot be read.
    let (code, out, err) = run(&["grade", "scene.json", "bob.json"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(
        out.contains("marks: 1 of 5") && out.contains("not read: drawing") && err.contains("bob.svg"),
        "{out}{err}"
    );
    let (code, out, err) = run(&["grade", "scene.json", "ada.json", "bob.json", "cy.json", "-o", "reports/"]);
    assert_eq!(code, Some(2), "{err}");
    assert!(out.contains("3 graded"), "{out}");
    assert!(err.contains("furlong") && err.contains("bob.svg"), "{err}");
    let marks = read("reports/marks.csv");
    let ada = marks.lines().find(|line| line.starts_with("ada.json")).unwrap();
    assert!(ada.contains(",1,5,") && ada.contains("not-read"), "{marks}");
    assert!(read("reports/faults.csv").contains("not-read"), "{marks}");
    assert_eq!(run(&["grade", "scene.json", "cy.json"]).0, Some(0));
    std::fs::remove_dir_all(&folder).unwrap();
}
