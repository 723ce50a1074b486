//! What a second lecturer found in reports: a name that right answers of the same hand-in contradict, a known mistake
//! that had no name, a polygon of forces that falls apart. Truth is calculated here.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::grade::{
    GradeSettings, HandIn, Kind, Report, Verdict, class_faults, grade_with_overlay, read_answers,
};
use linkgram::scene::{self, Scene};
use linkgram::sheet::Language;
use serde_json::{Value, json};

use crate::common::hand_in::{closed, graded};

fn read(text: &Value) -> Scene {
    scene::read(&text.to_string(), "scene.json").unwrap()
}

/// One mistake is named so, and costs one answer.
fn names(scene: &Value, answers: &Value, kind: Kind, wrong: &str) -> Report {
    let report = graded(&read(scene), answers);
    let amiss: Vec<&str> = report
        .quantities
        .iter()
        .filter(|one| one.verdict == Verdict::Wrong)
        .map(|one| one.name.as_str())
        .collect();
    let first = report.first_fault().and_then(|fault| fault.mistakes.first()).map(|mistake| mistake.kind);
    assert_eq!((first, amiss), (Some(kind), vec![wrong]), "{}", report.to_text());
    report
}

fn vector([x, y]: [f64; 2], unit: &str) -> Value {
    json!({ "components": [x, y], "unit": unit })
}

fn number(value: f64, unit: &str) -> Value {
    json!({ "value": format!("{value:.6} {unit}") })
}

fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

fn times(a: [f64; 2], by: f64) -> [f64; 2] {
    a.map(|part| by * part)
}

fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    plus(a, times(b, -1.0))
}

fn left([x, y]: [f64; 2]) -> [f64; 2] {
    [-y, x]
}

fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn long(a: [f64; 2]) -> f64 {
    libm::hypot(a[0], a[1])
}

/// The normal part of the lever alone points outward; C follows by the image of the lever, and the rod is drawn rightly.
#[test]
fn one_normal_part_outward_is_not_every_one() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -260] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 110 }, "4": { "joins": ["O4", "C"], "length": 520 },
            "5": { "joins": ["C", "D"], "length": 160 }
        },
        "slides": [
            { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "C" } },
            { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 240], "angle": 0 } }
        ],
        "near": { "C": [170, 230], "D": [0, 240] }, "input": { "link": 2, "angle": 35, "omega": "60 rpm ccw" },
        "find": ["v(A@4)", "omega(4)", "coriolis(A/4)", "an(A@4)", "alpha(4)", "aslip(A/4)", "a(D)", "alpha(5)"]
    });
    let (angle, rate) = (35_f64.to_radians(), 2.0 * std::f64::consts::PI);
    let crank = [110.0 * angle.cos(), 110.0 * angle.sin()];
    let (speed, whole) = (times(left(crank), rate), times(crank, -rate * rate));
    let arm = plus(crank, [0.0, 260.0]);
    let along = times(arm, 1.0 / long(arm));
    let across = left(along);
    let (under, slip) = (dot(speed, across), dot(speed, along));
    let omega = under / long(arm);
    let coriolis = 2.0 * omega * slip;
    let alpha = (dot(whole, across) - coriolis) / long(arm);
    // Outward: + ω² O4A.
    let normal = times(along, omega * omega * long(arm));
    let sliding = times(along, dot(whole, along) - dot(normal, along));
    let c = times(along, 520.0);
    let of_c = plus(times(c, omega * omega), times(left(c), alpha));
    let speed_of_c = times(left(c), omega);
    let up = 240.0 + 260.0 - c[1];
    let rod = [-(160.0_f64 * 160.0 - up * up).sqrt(), up];
    let turn = -speed_of_c[1] / rod[0];
    let alpha_five = (turn * turn * rod[1] - of_c[1]) / rod[0];
    let of_d = of_c[0] - turn * turn * rod[0] - alpha_five * rod[1];
    let answers = json!({ "values": {
        "v(A@4)": vector(times(across, under), "mm/s"), "omega(4)": number(omega, "rad/s"),
        "coriolis(A/4)": vector(times(across, coriolis), "mm/s^2"), "an(A@4)": vector(normal, "mm/s^2"),
        "alpha(4)": number(alpha, "rad/s^2"), "aslip(A/4)": vector(sliding, "mm/s^2"),
        "a(D)": vector([of_d, 0.0], "mm/s^2"), "alpha(5)": number(alpha_five, "rad/s^2"),
    }});
    let report = names(&scene, &answers, Kind::NormalAwayFromCentre, "an(A@4)");
    assert!(!report.to_text().contains("every"), "{}", report.to_text());
}

/// Crank 15 at 30°, 10 rad/s clockwise, coupler 45, rocker 30 cm: places and rates by the textbook's closed forms.
struct FourBar {
    a: [f64; 2],
    b: [f64; 2],
    omega: [f64; 2],
}

const PIVOT: [f64; 2] = [45.0, 15.0];

fn four_bar() -> FourBar {
    let angle = 30_f64.to_radians();
    let a = [15.0 * angle.cos(), 15.0 * angle.sin()];
    let across = minus(PIVOT, a);
    let far = long(across);
    let along = (45.0 * 45.0 - 30.0 * 30.0 + far * far) / (2.0 * far);
    let unit = times(across, 1.0 / far);
    let b = plus(a, plus(times(unit, along), times(left(unit), -(45.0 * 45.0 - along * along).sqrt())));
    let of = |from: [f64; 2], to: [f64; 2]| libm::atan2(to[1] - from[1], to[0] - from[0]);
    let (three, four) = (of(a, b), of(PIVOT, b));
    let omega = [
        -10.0 * 15.0 / 45.0 * (four - angle).sin() / (three - four).sin(),
        -10.0 * 15.0 / 30.0 * (angle - three).sin() / (four - three).sin(),
    ];
    FourBar { a, b, omega }
}

impl FourBar {
    fn speeds(&self) -> [[f64; 2]; 2] {
        [times(left(self.a), -10.0), times(left(minus(self.b, PIVOT)), self.omega[1])]
    }
}

fn four_bar_scene(find: &[&str]) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": PIVOT },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 15 }, "3": { "joins": ["A", "B"], "length": 45 },
            "4": { "joins": ["O4", "B"], "length": 30 }
        },
        "near": { "B": [52, -14] }, "input": { "link": 2, "angle": 30, "omega": "10 rad/s cw" }, "find": find
    })
}

/// V/l is no V²/l, nor is V²; as numbers of centimetres or of metres.
#[test]
fn a_square_or_a_length_that_was_forgotten_in_a_normal_part_is_named() {
    let own = four_bar();
    let scene = four_bar_scene(&["omega(3)", "an(B/A)"]);
    let (rate, toward) = (own.omega[0].abs(), times(minus(own.a, own.b), 1.0 / 45.0));
    for (size, unit, told) in [
        (rate, "cm/s^2", "V/l"),
        (rate, "m/s^2", "V/l"),
        (rate * rate * 45.0 * 45.0, "cm/s^2", "V² without its length"),
        (rate * rate * 0.45 * 0.45, "m/s^2", "V² without its length"),
    ] {
        let answers = json!({ "values": {
            "omega(3)": number(own.omega[0], "rad/s"), "an(B/A)": vector(times(toward, size), unit),
        }});
        let report = names(&scene, &answers, Kind::WrongFormula, "an(B/A)");
        assert!(report.to_text().contains(told), "{}", report.to_text());
    }
}

/// All velocities are written in m/s, but one says cm/s beside the number of metres.
#[test]
fn a_unit_that_no_other_answer_has_is_named() {
    let own = four_bar();
    let [a, b] = own.speeds();
    let metres = |of: [f64; 2]| vector(times(of, 0.01), "m/s");
    let answers = json!({ "values": {
        "v(A)": metres(a), "v(B/A)": metres(minus(b, a)), "v(B)": vector(times(b, 0.01), "cm/s"),
    }});
    names(&four_bar_scene(&["v(A)", "v(B/A)", "v(B)"]), &answers, Kind::MetreMixed, "v(B)");
}

/// Two vectors of one polygon, two letters of a drawing, two forces handed in for each other.
#[test]
fn what_is_handed_in_for_each_other_costs_one_mark() {
    let own = four_bar();
    let [a, b] = own.speeds();
    let cm = |of: [f64; 2]| vector(of, "cm/s");
    let answers = json!({ "values": {
        "v(A)": cm(a), "v(B/A)": cm(b), "v(B)": cm(minus(b, a)),
    }});
    names(&four_bar_scene(&["v(A)", "v(B/A)", "v(B)"]), &answers, Kind::Interchanged, "v(B/A)");
    // 2 cm/s to the millimetre of paper.
    let mm = |of: [f64; 2]| json!([of[0] / 2.0, of[1] / 2.0]);
    let answers = json!({
        "scales": { "velocity": "20 cm/s per cm" },
        "points": { "velocity": { "o": [0, 0], "a": mm(b), "b": mm(a) } },
    });
    let report = graded(&read(&four_bar_scene(&["v(A)", "v(B)"])), &answers);
    let kinds: Vec<Kind> =
        report.quantities.iter().filter_map(|one| one.mistakes.first()).map(|one| one.kind).collect();
    assert_eq!(kinds, [Kind::Interchanged], "{}", report.to_text());
    let (scene, [rod, lean, guide]) = engine(0.0);
    let thrust = [-rod * libm::cos(lean), rod * libm::sin(lean)];
    let answers = json!({ "values": {
        "F(3,4)": vector([0.0, guide], "N"), "F(1,4)": vector(times(thrust, -1.0), "N"),
    }});
    let report = graded(&read(&scene), &answers);
    let kinds: Vec<Kind> =
        report.quantities.iter().filter_map(|one| one.mistakes.first()).map(|one| one.kind).collect();
    assert_eq!(kinds, [Kind::Interchanged], "{}", report.to_text());
}

/// Crank 80 mm at 45°, rod 300 mm, 2 kN on the piston, which weighs so many newtons.
fn engine(weight: f64) -> (Value, [f64; 3]) {
    let mut scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 300 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } }],
        "near": { "B": [350, 0] }, "input": { "link": 2, "angle": 45, "omega": "300 rpm ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 2000, "direction": 180 }],
        "find": ["F(3,4)", "F(1,4)"]
    });
    if weight > 0.0 {
        scene["gravity"] = json!({});
        scene["masses"] = json!({ "4": { "weight": weight, "at": "B" } });
    }
    let lean = (80.0 * 45_f64.to_radians().sin() / 300.0).asin();
    (scene, [2000.0 / lean.cos(), lean, 2000.0 * lean.tan()])
}

/// A wheel on its rail: α = A/d for A/r, written down.
#[test]
fn the_diameter_of_a_wheel_for_its_radius_is_named() {
    let scene = json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 },
            "4": { "joins": ["B"] }
        },
        "rolls": [{
            "links": [1, 4], "line": { "link": 1, "through": [0, -15], "angle": 0 }, "centre": "B", "radius": 15
        }],
        "near": { "B": [58, 0] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
        "find": ["a(B)", "alpha(4)"]
    });
    let own = closed(30.0, 60_f64.to_radians(), 1.0);
    let answers = json!({ "values": {
        "a(B)": vector([own.acceleration, 0.0], "cm/s^2"), "alpha(4)": number(-own.acceleration / 30.0, "rad/s^2"),
    }});
    names(&scene, &answers, Kind::DiameterForRadius, "alpha(4)");
}

/// The number of the mass, W/g, drawn for the weight.
#[test]
fn a_weight_that_was_divided_by_g_is_not_left_out() {
    let (mut scene, [.., guide]) = engine(900.0);
    scene["find"] = json!(["F(1,4)"]);
    // So slow that nothing but the weight counts.
    scene["input"]["omega"] = json!("0.001 rad/s ccw");
    let own = |weight: f64| json!({ "values": { "F(1,4)": vector([0.0, guide + weight], "N") } });
    let right = graded(&read(&scene), &own(900.0));
    assert!(right.quantities.iter().all(|one| one.verdict == Verdict::Right), "{}", right.to_text());
    names(&scene, &own(900.0 / 9.806_65), Kind::MassAsWeight, "F(1,4)");
}

/// V_B drawn square to the crank: the lines meet in a, and V_BA is nothing.
#[test]
fn a_line_that_leaves_nothing_of_a_vector_is_named() {
    let own = four_bar();
    let [a, _] = own.speeds();
    let answers = json!({ "values": {
        "v(A)": vector(a, "cm/s"), "v(B)": vector(a, "cm/s"), "v(B/A)": vector([0.3, 0.1], "cm/s"),
    }});
    let report = graded(&read(&four_bar_scene(&["v(A)", "v(B/A)", "v(B)"])), &answers);
    let first = report.first_fault().and_then(|fault| fault.mistakes.first()).map(|mistake| mistake.kind);
    assert_eq!(first, Some(Kind::WrongLine), "{}", report.to_text());
}

/// A vector is read in the form in which sheets and reports print it.
#[test]
fn a_vector_is_read_as_it_is_printed() {
    let own = four_bar();
    let [a, b] = own.speeds();
    let told = |of: [f64; 2], degrees: &str| {
        format!("{:.3} cm/s at {:.2}{degrees}", long(of), libm::atan2(of[1], of[0]).to_degrees())
    };
    let answers = json!({ "values": { "v(A)": told(a, "°"), "v(B)": told(b, " deg") } });
    let report = graded(&read(&four_bar_scene(&["v(A)", "v(B)"])), &answers);
    assert!(report.quantities.iter().all(|one| one.verdict == Verdict::Right), "{}", report.to_text());
}

/// Each number with its unit runs from left to right, and no word of another direction stands within it.
#[test]
fn numbers_of_an_arabic_page_are_not_turned_about() {
    let own = four_bar();
    let [_, b] = own.speeds();
    let text =
        json!({ "values": { "v(B)": { "magnitude": format!("{:.2} cm/s", long(b)), "direction": 12.5 } } });
    let scene = read(&four_bar_scene(&["v(B)"]));
    let answers = read_answers(&text.to_string(), &scene).unwrap();
    for language in ["ar", "fa"] {
        let settings =
            GradeSettings { language: Language::from_tag(language).unwrap(), ..GradeSettings::default() };
        let (report, _) = grade_with_overlay(&scene, &answers, &settings).unwrap();
        let page = report.to_html("x", None);
        let runs: Vec<&str> =
            page.split("<bdi dir=\"ltr\">").skip(1).filter_map(|part| part.split("</bdi>").next()).collect();
        assert!(runs.iter().any(|run| run.contains("cm/s")), "{page}");
        assert!(runs.iter().any(|run| run.contains("12.5°")), "{page}");
        let arabic = |sign: char| ('\u{621}'..='\u{6d3}').contains(&sign);
        assert!(!runs.iter().any(|run| run.contains(arabic)), "{page}");
    }
}

/// The forces that a student has on a body close as he drew them: tip to tail, whatever the right ones are.
#[test]
fn the_force_polygon_of_a_student_closes() {
    let (scene, [rod, lean, guide]) = engine(0.0);
    // The guide's force to the other side, and the rod's as it closes with that: (2000, +2000 tan β).
    let answers = json!({ "values": {
        "F(3,4)": vector([rod * libm::cos(lean), guide], "N"), "F(1,4)": vector([0.0, -guide], "N"),
    }});
    let scene = read(&scene);
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let (_, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    let mut lines = Vec::new();
    figure.unwrap().root.walk(&mut |node| {
        use linkgram::sheet::figure::{Node, Shape};
        if let Node::Mark(mark) = node
            && let (Shape::Line(from, to), "student") = (&mark.shape, mark.class)
        {
            lines.push([*from, *to]);
        }
    });
    // On the piston: the load and the guide's force, or the rod's and the guide's, and what is not his again.
    let closes = (0..lines.len()).any(|first| {
        (first + 1..lines.len()).any(|last| {
            let chain = &lines[first..=last];
            let joined = chain.windows(2).all(|two| two[0][1].distance(two[1][0]) < 1e-6);
            joined && chain.len() > 1 && {
                // With the load, 2000 N to the left, which may stand solid before them.
                let way = chain[chain.len() - 1][1] - chain[0][0];
                way.hypot() < 1e-6 || way.y.abs() < 1e-6
            }
        })
    });
    assert!(closes, "{lines:?}");
}

/// One read ac, another bc for oc: the class is told what both did.
#[test]
fn a_class_is_told_what_all_of_it_did() {
    let own = four_bar();
    let mut scene = four_bar_scene(&["v(A)", "v(B)"]);
    scene["links"]["4"] = json!({ "joins": ["O4", "B", "C"], "arms": [30, 20, 40] });
    scene["find"] = json!(["v(A)", "v(B)", "v(C)"]);
    scene["near"] = json!({ "B": [52, -14], "C": [60, 5] });
    let scene = read(&scene);
    let [a, b] = own.speeds();
    let rocker = times(minus(own.b, PIVOT), 20.0 / 30.0);
    let (sin, cos) = (40_f64.to_radians().sin(), 40_f64.to_radians().cos());
    let c = times(left([cos * rocker[0] - sin * rocker[1], sin * rocker[0] + cos * rocker[1]]), own.omega[1]);
    let class: Vec<HandIn> = [a, b]
        .into_iter()
        .map(|from| {
            let answers = json!({ "values": {
                "v(A)": vector(a, "cm/s"), "v(B)": vector(b, "cm/s"), "v(C)": vector(minus(c, from), "cm/s"),
            }});
            HandIn { file: String::new(), outcome: Ok(graded(&scene, &answers)) }
        })
        .collect();
    let faults = class_faults(&class);
    let both: Vec<_> = faults.iter().filter(|fault| fault.students == 2).collect();
    assert_eq!(both.len(), 1, "{faults:?}");
    assert!(!both[0].text.contains("ac") && !both[0].text.contains("bc"), "{faults:?}");
}
