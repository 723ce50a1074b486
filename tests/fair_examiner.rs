//! `grade` is fair: nobody sets his own tolerance, one mistake costs one mark, what is told fits, and what people type and
//! draw is read.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::process::Command;

use linkgram::grade::{GradeSettings, Kind, Report, Verdict, grade, grade_with_overlay, read_answers};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

use crate::common::hand_in::{Closed, closed, graded};

const CRANK: f64 = 30.0;
const ROD: f64 = 50.0;
const RATE: f64 = 10.0;

/// A slider-crank: crank 30 cm at an angle, rod 50 cm, 10 rad/s counter-clockwise.
fn slider(degrees: f64, find: &[&str]) -> Scene {
    let text = json!({
        "title": "Slider-crank", "units": { "length": "cm" },
        "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": CRANK }, "3": { "joins": ["A", "B"], "length": ROD } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [58, 0] },
        "input": { "link": 2, "angle": degrees, "omega": "10 rad/s ccw" },
        "find": find
    });
    scene::read(&text.to_string(), "slider.json").unwrap()
}

const ALL: [&str; 4] = ["v(B)", "omega(3)", "a(B)", "alpha(3)"];

fn values(own: &Closed) -> Value {
    json!({
        "v(B)": { "components": [format!("{:.3} cm/s", own.speed), "0 cm/s"] },
        "omega(3)": { "value": format!("{:.4} rad/s", own.omega) },
        "a(B)": { "components": [format!("{:.2} cm/s^2", own.acceleration), "0 cm/s^2"] },
        "alpha(3)": { "value": format!("{:.4} rad/s^2", own.alpha) },
    })
}

fn wrong(report: &Report) -> Vec<&str> {
    let wrong = report.quantities.iter().filter(|one| one.verdict == Verdict::Wrong);
    wrong.map(|one| one.name.as_str()).collect()
}

fn first(report: &Report) -> Option<Kind> {
    Some(report.first_fault()?.mistakes.first()?.kind)
}

fn degrees(angle: f64) -> f64 {
    angle.to_radians()
}

#[test]
fn nobody_sets_the_tolerance_of_what_he_hands_in() {
    let scene = slider(60.0, &["v(B)"]);
    let right = closed(CRANK, degrees(60.0), 1.0);
    let off = format!("{:.2} cm/s", 1.08 * right.speed.abs());
    for stated in
        [json!({ "v(B)": "50 %" }), json!({ "length": "10 mm", "angle": "10 deg" }), json!({ "v(B)": 400 })]
    {
        let answers = json!({ "values": { "v(B)": off }, "tolerance": stated });
        let report = graded(&scene, &answers);
        assert_eq!(wrong(&report), ["v(B)"], "{}", report.to_text());
        let text = report.to_text();
        assert!(text.contains("does not count: the examiner sets it"), "{text}");
        assert!(report.to_html("T", None).contains("does not count"));
        assert_eq!(report.to_json()["tolerances_ignored"], true);
        // Of the examiner's own answers it counts.
        let trusted = GradeSettings { trusts_answers: true, ..GradeSettings::default() };
        let answers = read_answers(&answers.to_string(), &scene).unwrap();
        assert!(wrong(&grade(&scene, &answers, &trusted).unwrap()).is_empty());
    }
    assert!(!graded(&scene, &json!({ "values": { "v(B)": off } })).to_text().contains("does not count"));
}

#[test]
fn an_input_laid_off_from_the_other_side_costs_one_mark() {
    for angle in [50.0, 60.0, 130.0] {
        let report = graded(
            &slider(angle, &ALL),
            &json!({ "values": values(&closed(CRANK, degrees(180.0 - angle), 1.0)) }),
        );
        assert_eq!(wrong(&report).len(), 1, "{}", report.to_text());
        assert_eq!(first(&report), Some(Kind::InputAngle), "{}", report.to_text());
    }
}

/// The degrees as they are written go into the calculator, not those that are left of them.
#[test]
fn a_calculator_in_radians_takes_the_angle_that_is_written() {
    for angle in [40.0, 200.0, 300.0] {
        let report = graded(&slider(angle, &ALL), &json!({ "values": values(&closed(CRANK, angle, 1.0)) }));
        assert_eq!(wrong(&report).len(), 1, "{angle}: {}", report.to_text());
        assert_eq!(first(&report), Some(Kind::CalculatorInRadians), "{angle}: {}", report.to_text());
    }
}

/// The skeleton is handed in, at 1:10, and all that follows from it.
#[test]
fn what_follows_from_a_fault_of_the_skeleton_counts() {
    let scene = slider(60.0, &ALL);
    for (crank, angle, kind) in
        [(CRANK, 70.0, Kind::InputAngle), (CRANK, 62.0, Kind::InputAngle), (33.0, 60.0, Kind::LengthLaidOff)]
    {
        let own = closed(crank, degrees(angle), 1.0);
        let answers = json!({
            "values": values(&own), "scales": { "length": "1:10" },
            "points": { "skeleton": { "O2": [0, 0], "A": own.a, "B": own.b } },
        });
        let report = graded(&scene, &answers);
        assert_eq!(wrong(&report), ["skeleton:A"], "{}", report.to_text());
        assert_eq!(first(&report), Some(kind), "{}", report.to_text());
        let (reached, of) = report.sum();
        assert_eq!((reached, of), (3.0, 4.0), "{}", report.to_text());
    }
}

#[test]
fn a_slip_in_the_first_velocity_costs_one_mark() {
    for enlarged in [0.8, 1.2, 1.3] {
        let own = closed(CRANK, degrees(60.0), enlarged);
        let report = graded(&slider(60.0, &ALL), &json!({ "values": values(&own) }));
        assert_eq!(wrong(&report).len(), 1, "{enlarged}: {}", report.to_text());
    }
}

/// I₁₃ misread along the crank; ω₃ and V_B from it.
#[test]
fn what_follows_from_a_wrong_centre_counts() {
    let scene = slider(60.0, &["I(1,3)", "omega(3)", "v(B)"]);
    let right = closed(CRANK, degrees(60.0), 1.0);
    // The crank's line and the vertical through B.
    let centre = [right.b[0], right.b[0] * degrees(60.0).tan()];
    let longer = 1.0 + 8.0 / libm::hypot(centre[0], centre[1]);
    let own = centre.map(|x| x * longer);
    let to_a = libm::hypot(own[0] - right.a[0], own[1] - right.a[1]);
    let omega = RATE * CRANK / to_a;
    let arm = [right.b[0] - own[0], right.b[1] - own[1]];
    let answers = json!({ "values": {
        "I(1,3)": { "components": [format!("{:.2} cm", own[0]), format!("{:.2} cm", own[1])] },
        "omega(3)": format!("{omega:.4} rad/s cw"),
        "v(B)": { "components": [format!("{:.2} cm/s", omega * arm[1]), format!("{:.2} cm/s", -omega * arm[0])] },
    }});
    let report = graded(&scene, &answers);
    assert_eq!(wrong(&report), ["I(1,3)"], "{}", report.to_text());
}

/// The slot of a shaper at many angles: V of the slot's point drawn along the slot, sliding square to it.
#[test]
fn the_lines_of_a_slot_exchanged_cost_one_mark() {
    let (crank, apart, rate) = (14.0, 36.0, 4.0);
    for angle in [20.0, 40.0, 100.0, 140.0, 200.0, 320.0] {
        let text = json!({
            "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, -apart] },
            "links": { "2": { "joins": ["O2", "A"], "length": crank }, "4": { "joins": ["O4", "B"], "length": 66 } },
            "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } }],
            "near": { "B": [0, 30] },
            "input": { "link": 2, "angle": angle, "omega": "4 rad/s ccw" },
            "find": ["omega(4)", "slip(A/4)"]
        });
        let scene = scene::read(&text.to_string(), "shaper.json").unwrap();
        let (sin, cos) = degrees(angle).sin_cos();
        let arm = [crank * cos, crank * sin + apart];
        let long = libm::hypot(arm[0], arm[1]);
        let along = arm.map(|x| x / long);
        let v = [-rate * crank * sin, rate * crank * cos];
        let sliding = v[0] * along[0] + v[1] * along[1];
        let turning = v[1] * along[0] - v[0] * along[1];
        for sense in [1.0, -1.0] {
            let answers = json!({ "values": {
                "omega(4)": { "value": format!("{:.4} rad/s", sense * sliding / long) },
                "slip(A/4)": { "components": [format!("{:.3} cm/s", -turning * along[1]), format!("{:.3} cm/s", turning * along[0])] },
            }});
            let report = graded(&scene, &answers);
            assert_eq!(wrong(&report).len(), 1, "{angle} {sense}: {}", report.to_text());
        }
    }
}

/// A block that rubs is pushed by a rod; the student forgets that it rubs.
#[test]
fn friction_left_out_is_named_and_costs_one_mark() {
    let text = json!({
        "units": { "length": "cm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": CRANK }, "3": { "joins": ["A", "B"], "length": ROD } },
        "slides": [{ "pin": "B", "block": 4, "f": 0.2, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [58, 0] },
        "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 900, "direction": "against" }],
        "find": ["F(3,4)", "F(1,4)", "T(2)"]
    });
    let scene = scene::read(&text.to_string(), "rubbing.json").unwrap();
    let Closed { a, b, .. } = closed(CRANK, degrees(60.0), 1.0);
    let rod = [(b[0] - a[0]) / ROD, (b[1] - a[1]) / ROD];
    // B moves to the left, the load to the right: the rod pulls the block, and the guide holds it square to itself.
    let pull = -900.0 / rod[0];
    let on_block = rod.map(|x| pull * x);
    let guide = -on_block[1];
    let on_crank = rod.map(|x| -pull * x);
    // What the crank needs is against the moment of the rod.
    let torque = (a[1] * on_crank[0] - a[0] * on_crank[1]) / 100.0;
    let answers = json!({ "values": {
        "F(3,4)": { "components": [format!("{:.2} N", on_block[0]), format!("{:.2} N", on_block[1])] },
        "F(1,4)": { "components": ["0 N", format!("{guide:.2} N")] },
        "T(2)": { "value": format!("{:.3} N*m", torque) },
    }});
    let report = graded(&scene, &answers);
    assert_eq!(wrong(&report).len(), 1, "{}", report.to_text());
    assert_eq!(first(&report), Some(Kind::FrictionLeftOut), "{}", report.to_text());
}

#[test]
fn what_people_type_is_read() {
    let scene = slider(60.0, &["v(B)", "omega(3)"]);
    let own = closed(CRANK, degrees(60.0), 1.0);
    let (speed, omega) = (own.speed.abs(), own.omega.abs());
    for answers in [
        format!(
            r#"{{"values":{{"v(B)":{{"components":["−{speed:.2} cm/s",0]}},"omega(3)":"−{omega:.4} rad/s"}}}}"#
        ),
        format!(
            r#"{{"values":{{"v(B)":{{"magnitude":"{speed:.2} cm/s","direction":"180.0°"}},"omega(3)":"{omega:.4} rad/s clockwise"}}}}"#
        ),
        format!(
            r#"{{"values":{{"v(B)":"{speed:.2} cm/s","omega(3)":{{"value":"{omega:.4} rad/s","sense":"CW"}}}}}}"#
        ),
        format!(
            "quantity,value,unit,sense,direction\nv(B),{speed:.2},cm/s,,180°\nomega(3),{omega:.4},rad/s,Clockwise,\n"
        ),
        format!("quantity,value,unit\nv(B),{speed:.2},cm/s\nomega(3),−{omega:.4},rad/s\n"),
    ] {
        let read = read_answers(&answers, &scene).unwrap_or_else(|told| panic!("{answers}: {told}"));
        let report = grade(&scene, &read, &GradeSettings::default()).unwrap();
        assert!(wrong(&report).is_empty(), "{}", report.to_text());
    }
    // The other sense is not read as this one.
    for typed in ["counter clockwise", "counter-clockwise", "Anticlockwise"] {
        let report =
            graded(&scene, &json!({ "values": { "omega(3)": format!("{omega:.4} rad/s {typed}") } }));
        assert_eq!(wrong(&report), ["omega(3)"], "{typed}");
    }
    let told = read_answers(r#"{"values":{"v(B)":"1,551 cm/s"}}"#, &scene).unwrap_err().to_string();
    assert!(told.contains("thousands or decimals") && told.contains("1551 cm/s"), "{told}");
    let told = read_answers(r#"{"values":{"v(B)":"15,5 cm/s"}}"#, &scene).unwrap_err().to_string();
    assert!(told.contains("write a decimal point: 15.5 cm/s"), "{told}");
}

/// Lines whose ends nobody snapped together, and the lines of a sheet's text that run from right to left.
#[test]
fn ends_that_a_pencil_leaves_apart_are_one_point() {
    let svg = r#"<svg xmlns="http://www.w3.org/2000/svg" width="200mm" height="200mm" viewBox="0 0 200 200">
        <g class="sentence"><text class="arabic" x="150" y="20" font-size="4">في</text><text x="140" y="20" font-size="4">A</text></g>
        <path d="M20,100 L60,60"/><path d="M60.4,60.3 L140,100"/><path d="M19.8,100.1 L140.3,100.3"/>
        <text x="15" y="106" font-size="4">O2</text><text x="59" y="57" font-size="4">A</text><text x="142" y="106" font-size="4">B</text></svg>"#;
    let answers = read_answers(svg, &slider(60.0, &["v(B)"])).unwrap();
    let a = answers.figures[0].points.iter().find(|(name, ..)| name == "A").unwrap().1;
    assert!((a[0] - 60.2).abs() < 0.01 && (a[1] + 60.15).abs() < 0.01, "{a:?}");
}

/// A point of a polygon that lies metres off does not make the overlay that large.
#[test]
fn a_far_point_leaves_the_overlay_to_be_seen() {
    let scene = slider(60.0, &["v(B)", "omega(3)"]);
    let answers = json!({ "points": { "velocity": { "o": [0, 0], "a": [-50, 30], "b": [-19000, 0] } } });
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let (_, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    let figure = figure.unwrap();
    assert!(figure.width < 1000.0 && figure.height < 1000.0, "{} {}", figure.width, figure.height);
}

fn program(arguments: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn messages_name_what_is_wrong() {
    let folder = std::env::temp_dir().join(format!("linkgram-fair-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("exam")).unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.join(name), text).unwrap();
    let path = |name: &str| folder.join(name).to_str().unwrap().to_owned();
    write("exam/exam.json", r#"{ "hand": { "length_mm": 0.2, "angle_deg": 0.3 }, "max_tolerance": 0.1 }"#);
    write("broken.json", r#"{ "values": { "v(B)": "#);
    write("empty.csv", "\n");
    let (code, _, told) = program(&["grade", &path("exam"), &path("broken.json")]);
    assert_eq!(code, Some(2));
    assert!(told.contains("broken.json:1:") && told.contains("not JSON"), "{told}");
    let (_, _, told) = program(&["grade", &path("exam"), &path("empty.csv")]);
    assert!(told.contains("the file is empty"), "{told}");
    // Whichever end is said first.
    write("scene.json", slider(60.0, &["v(B)"]).source.text());
    let rows = |from: &str, to: &str| {
        let (code, out, told) = program(&[
            "sweep",
            &path("scene.json"),
            "--steps",
            "4",
            "--from",
            from,
            "--to",
            to,
            "-o",
            &path("rows.csv"),
        ]);
        assert_eq!(code, Some(0), "{out}{told}");
        std::fs::read_to_string(folder.join("rows.csv")).unwrap()
    };
    assert_eq!(rows("360", "0"), rows("0", "360"));
    write(
        "comma.json",
        &slider(60.0, &["v(B)"]).source.text().replace("\"10 rad/s ccw\"", "\"10,5 rad/s ccw\""),
    );
    let (_, _, told) = program(&["solve", &path("comma.json")]);
    assert!(told.contains("decimal comma"), "{told}");
    std::fs::remove_dir_all(&folder).unwrap();
}

/// Velocities twice as large throughout, and A_D half as large again as it follows from them (2490): no drawing has all of
/// that. Before, the drawings that have some of a student's answers led to it.
#[test]
fn what_no_drawing_of_the_student_leads_to_does_not_follow() {
    let name = "s000-ch3a-1.json";
    let text = std::fs::read_to_string(format!("{}/examples/{name}", env!("CARGO_MANIFEST_DIR"))).unwrap();
    let scene = scene::read(&text, name).unwrap();
    let verdict = |own: &str| {
        let vector = |size: &str, at: f64| json!({ "magnitude": size, "direction": at });
        let turning = |value: &str, sense: &str| json!({ "value": value, "sense": sense });
        let answers = json!({ "values": {
            "v(B)": vector("351 cm/s", 14.5), "omega(3)": turning("8.8 rad/s", "ccw"),
            "omega(4)": turning("11.7 rad/s", "ccw"), "v(D)": vector("358 cm/s", -179.9),
            "omega(5)": turning("2.46 rad/s", "cw"), "an(B/A)": vector("3490 cm/s^2", 151.0),
            "a(B)": vector("4550 cm/s^2", 130.1), "alpha(3)": turning("65.1 rad/s^2", "ccw"),
            "alpha(4)": turning("66.2 rad/s^2", "cw"), "a(D)": vector(own, -0.1),
            "alpha(5)": turning("94.6 rad/s^2", "cw")
        } });
        let report = graded(&scene, &answers);
        report.quantities.iter().find(|one| one.name == "a(D)").unwrap().verdict
    };
    assert_eq!(verdict("2490 cm/s^2"), Verdict::Consistent);
    assert_eq!(verdict("3740 cm/s^2"), Verdict::Wrong);
}

/// Zero, and one newton for thousands, follow from nothing that is shown.
#[test]
fn nothing_throughout_brings_no_marks() {
    let text = json!({
        "title": "Gas force", "units": { "length": "mm" },
        "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 200 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } }],
        "near": { "B": [245, 0] },
        "input": { "link": 2, "angle": 40, "omega": "1000 rpm ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "pressure": "18 bar", "bore": 80, "direction": 180 }],
        "find": ["load(P)", "F(3,4)", "F(1,4)", "F(1,2)", "T(2)"]
    });
    let scene = scene::read(&text.to_string(), "gas.json").unwrap();
    for one in [0.0, 1.0] {
        let values =
            ["load(P)", "F(3,4)", "F(1,4)", "F(1,2)", "T(2)"].map(|name| (name.to_owned(), json!(one)));
        let answers = json!({ "values": values.into_iter().collect::<serde_json::Map<_, _>>() });
        let report = graded(&scene, &answers);
        assert!(report.quantities.iter().all(|one| one.verdict == Verdict::Wrong), "{report:?}");
    }
}
