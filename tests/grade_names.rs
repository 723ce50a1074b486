//! A student is told what he did, and sees it circled where he has it. What he hands in is calculated here by closed forms,
//! with one mistake.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::grade::{GradeSettings, Kind, Report, Verdict, grade_with_overlay, read_answers};
use linkgram::render::{Format, Options, render};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

use crate::common::hand_in::{Closed, closed, graded};

fn read(text: &Value) -> Scene {
    scene::read(&text.to_string(), "scene.json").unwrap()
}

/// The kind that is named first, and what is wrong.
fn told(report: &Report) -> (Option<Kind>, Vec<&str>) {
    let wrong = report.quantities.iter().filter(|one| one.verdict == Verdict::Wrong);
    let kind = report.first_fault().and_then(|fault| fault.mistakes.first()).map(|mistake| mistake.kind);
    (kind, wrong.map(|one| one.name.as_str()).collect())
}

/// One mistake is named so and costs one answer.
fn names(scene: &Value, values: &Value, kind: Kind, wrong: &str) -> Report {
    let report = graded(&read(scene), &json!({ "values": values }));
    assert_eq!(told(&report), (Some(kind), vec![wrong]), "{}", report.to_text());
    report
}

fn vector([x, y]: [f64; 2], unit: &str) -> Value {
    json!({ "components": [x, y], "unit": unit })
}

fn number(value: f64, unit: &str) -> Value {
    json!({ "value": format!("{value:.5} {unit}") })
}

fn slider(omega: &str) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [58, 0] }, "input": { "link": 2, "angle": 60, "omega": omega },
        "find": ["v(A)", "v(B)", "omega(3)", "a(B)", "alpha(3)"]
    })
}

/// What [`closed`] finds at 10 rad/s, at so many times that speed.
fn of_slider(own: &Closed, crank: f64, angle: f64, faster: f64) -> Value {
    let speed = 10.0 * faster * crank;
    json!({
        "v(A)": vector([-speed * angle.sin(), speed * angle.cos()], "cm/s"),
        "v(B)": vector([faster * own.speed, 0.0], "cm/s"),
        "omega(3)": number(faster * own.omega, "rad/s"),
        "a(B)": vector([faster * faster * own.acceleration, 0.0], "cm/s^2"),
        "alpha(3)": number(faster * faster * own.alpha, "rad/s^2"),
    })
}

/// 60 rpm are 360° per second, and no 360 rad/s.
#[test]
fn degrees_per_second_in_the_input_are_named() {
    let angle = 60_f64.to_radians();
    let values = of_slider(&closed(30.0, angle, 1.0), 30.0, angle, 36.0);
    names(&slider("60 rpm ccw"), &values, Kind::DegAsRad, "v(A)");
}

/// No place of the skeleton is handed in: all answers together tell the angle or the length.
#[test]
fn an_angle_or_a_length_that_all_answers_tell_is_named() {
    let scene = slider("10 rad/s ccw");
    let angle = 67_f64.to_radians();
    let report =
        names(&scene, &of_slider(&closed(30.0, angle, 1.0), 30.0, angle, 1.0), Kind::InputAngle, "v(A)");
    assert!(report.to_text().contains("about 7° too far counter-clockwise"), "{}", report.to_text());
    let angle = 60_f64.to_radians();
    let report =
        names(&scene, &of_slider(&closed(33.5, angle, 1.0), 33.5, angle, 1.0), Kind::LengthLaidOff, "v(A)");
    assert!(report.to_text().contains("about 12 % too long"), "{}", report.to_text());
}

/// Crank 15 and coupler 45 cm, rocker 30 cm about the second pivot; crank at 30°, 10 rad/s clockwise.
struct FourBar {
    b: [f64; 2],
    omega: [f64; 2],
    pivot: [f64; 2],
}

impl FourBar {
    fn about(pivot: [f64; 2]) -> Self {
        let (crank, coupler, rocker, angle) = (15.0, 45.0, 30.0, 30_f64.to_radians());
        let a = [crank * angle.cos(), crank * angle.sin()];
        let across = [pivot[0] - a[0], pivot[1] - a[1]];
        let far: f64 = libm::hypot(across[0], across[1]);
        let along = (coupler * coupler - rocker * rocker + far * far) / (2.0 * far);
        let beside = (coupler * coupler - along * along).sqrt();
        let unit = across.map(|part| part / far);
        // Below the line from A to the pivot.
        let b = [0, 1].map(|axis| a[axis] + along * unit[axis] + beside * [unit[1], -unit[0]][axis]);
        let of = |from: [f64; 2], to: [f64; 2]| libm::atan2(to[1] - from[1], to[0] - from[0]);
        let (three, four) = (of(a, b), of(pivot, b));
        // The textbook's ratios of a four-bar linkage.
        let rate = -10.0;
        let omega = [
            rate * crank / coupler * (four - angle).sin() / (three - four).sin(),
            rate * crank / rocker * (angle - three).sin() / (four - three).sin(),
        ];
        Self { b, omega, pivot }
    }

    fn speed(&self) -> [f64; 2] {
        [-self.omega[1] * (self.b[1] - self.pivot[1]), self.omega[1] * (self.b[0] - self.pivot[0])]
    }

    fn scene(find: &[&str]) -> Value {
        json!({
            "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [45, 15] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 15 }, "3": { "joins": ["A", "B"], "length": 45 },
                "4": { "joins": ["O4", "B"], "length": 30 }
            },
            "near": { "B": [52, -14] }, "input": { "link": 2, "angle": 30, "omega": "10 rad/s cw" },
            "find": find
        })
    }
}

#[test]
fn a_pivot_that_all_answers_tell_is_named() {
    let own = FourBar::about([42.0, 13.0]);
    let values = json!({
        "v(B)": vector(own.speed(), "cm/s"), "omega(3)": number(own.omega[0], "rad/s"),
        "omega(4)": number(own.omega[1], "rad/s"), "ratio(4/2)": own.omega[1] / -10.0,
    });
    let scene = FourBar::scene(&["v(B)", "omega(3)", "omega(4)", "ratio(4/2)"]);
    let report = graded(&read(&scene), &json!({ "values": values }));
    assert_eq!(told(&report).0, Some(Kind::PivotMisplaced), "{}", report.to_text());
    assert!(report.to_text().contains("O4"), "{}", report.to_text());
}

#[test]
fn another_length_in_a_normal_part_and_inverted_arms_are_named() {
    let right = FourBar::about([45.0, 15.0]);
    let [three, four] = right.omega;
    let a = [15.0 * 30_f64.to_radians().cos(), 7.5];
    let toward = [a[0] - right.b[0], a[1] - right.b[1]].map(|part| part / 45.0 * three * three * 30.0);
    let values = json!({
        "omega(3)": number(three, "rad/s"), "an(B/A)": vector(toward, "cm/s^2"),
    });
    names(&FourBar::scene(&["omega(3)", "an(B/A)"]), &values, Kind::NormalOfWrongLink, "an(B/A)");
    // (24–14)/(24–12) in the place of (24–12)/(24–14).
    let ratio = -10.0 / four;
    let values = json!({
        "omega(3)": number(three, "rad/s"), "omega(4)": number(-10.0 * ratio, "rad/s"), "ratio(4/2)": ratio,
    });
    let scene = FourBar::scene(&["omega(3)", "omega(4)", "ratio(4/2)"]);
    names(&scene, &values, Kind::RatioInverted, "omega(4)");
}

/// Areas of +3 and −1 by turns over half a turn: 100 N m and 10° for a unit; 500 N at a radius of gyration of 0.4 m.
#[test]
fn what_turns_and_the_scale_of_areas_have_their_mistakes_named() {
    let scene = json!({
        "links": {}, "input": { "omega": "600 rpm" },
        "cycle": {
            "torque": { "areas": [4, -6, 5, -3], "scale": { "torque": "100 N*m", "angle": "10 deg" }, "total": 90 },
            "period": 180, "rotating": [{ "weight": 500, "gyration": "400 mm" }]
        },
        "find": ["Tmean", "Ef", "I", "Ks"]
    });
    let g = 9.806_65;
    let (unit, omega) = (100.0 * 10_f64.to_radians(), 20.0 * std::f64::consts::PI);
    // Levels 0, 4, −2, 3, 0.
    let (mean, levels, inertia) = (90.0 * unit / std::f64::consts::PI, 6.0 * unit, 500.0 / g * 0.16);
    let values = |unit: f64, inertia: f64, squared: f64| json!({ "Tmean": mean * unit, "Ef": levels * unit, "I": inertia, "Ks": levels * unit / (inertia * squared) });
    let square = omega * omega;
    assert_eq!(told(&graded(&read(&scene), &json!({ "values": values(1.0, inertia, square) }))).1.len(), 0);
    names(&scene, &values(1.0, inertia, omega), Kind::RateNotSquared, "Ks");
    names(&scene, &values(1.0, inertia / 4.0, square), Kind::DiameterForRadius, "I");
    names(&scene, &values(1.0, inertia * g, square), Kind::WeightAsMass, "I");
    names(&scene, &values(1.0 / 10_f64.to_radians(), inertia, square), Kind::ScaleForgotten, "Tmean");
}

/// Crank 80 mm at 45°, rod 300 mm, 2 kN on the piston.
fn engine() -> (Value, [f64; 3]) {
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 300 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } }],
        "near": { "B": [350, 0] }, "input": { "link": 2, "angle": 45, "omega": "300 rpm ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 2000, "direction": 180 }],
        "find": ["F(3,4)", "F(1,4)", "T(2)"]
    });
    let lean = (80.0 * 45_f64.to_radians().sin() / 300.0).asin();
    (scene, [2000.0 / lean.cos(), lean, 2000.0 * lean.tan()])
}

#[test]
fn the_length_of_the_rod_for_the_arm_of_its_force_is_named() {
    let (scene, [rod, lean, guide]) = engine();
    let values = json!({
        "F(3,4)": vector([2000.0, -2000.0 * lean.tan()], "N"), "F(1,4)": vector([0.0, guide], "N"),
        "T(2)": format!("{:.2} N*m cw", rod * 0.3),
    });
    names(&scene, &values, Kind::ArmToPin, "T(2)");
}

/// The picture of one hand-in.
fn picture(scene: &Value, values: &Value) -> String {
    let scene = read(scene);
    let answers = read_answers(&json!({ "values": values }).to_string(), &scene).unwrap();
    let (_, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    let svg = render(&figure.unwrap(), Format::Svg, &Options::default()).unwrap();
    String::from_utf8(svg).unwrap()
}

#[test]
fn a_wrong_force_is_circled_in_the_polygon_of_its_body() {
    let (scene, [_, lean, guide]) = engine();
    let values = json!({
        "F(3,4)": vector([2000.0, -2000.0 * lean.tan()], "N"), "F(1,4)": vector([0.0, -2.0 * guide], "N"),
    });
    let svg = picture(&scene, &values);
    assert!(svg.contains("class=\"fault\"") && svg.contains("force-polygon"), "{svg}");
}

/// A centre that is asked is circled on the skeleton, and no polygon is drawn that nobody was asked for.
#[test]
fn a_wrong_centre_is_circled_on_the_skeleton() {
    let mut scene = FourBar::scene(&["I(1,3)", "I(2,4)"]);
    scene["find"] = json!(["I(1,3)", "I(2,4)", { "name": "omega(4)", "method": "centres" }]);
    let values = json!({ "I(2,4)": vector([-30.0, -10.0], "cm"), "omega(4)": "5.84 rad/s ccw" });
    let svg = picture(&scene, &values);
    assert!(svg.contains("class=\"fault\"") && svg.contains("class=\"skeleton\""), "{svg}");
    assert!(!svg.contains("velocity"), "{svg}");
}

/// The slot's parallel and square lines exchanged: the point under the pin moves along the slot, the pin square to it.
/// What is calculated from that with Coriolis follows.
#[test]
fn what_follows_from_the_lines_of_a_slot_exchanged_has_its_marks() {
    let scene = json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, -12] },
        "links": { "2": { "joins": ["O2", "A"], "length": 20 }, "4": { "joins": ["O4", "B"], "length": 20 } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } }],
        "near": { "B": [12, -28] }, "input": { "link": 2, "angle": 150, "omega": "1.5 rad/s cw" },
        "find": ["v(A@4)", "slip(A/4)", "omega(4)", "coriolis(A/4)", "alpha(4)"]
    });
    let angle = 150_f64.to_radians();
    let a = [20.0 * angle.cos(), 20.0 * angle.sin()];
    let arm = [a[0], a[1] + 12.0];
    let long = libm::hypot(arm[0], arm[1]);
    let (along, across) = (arm.map(|part| part / long), [-arm[1] / long, arm[0] / long]);
    let (speed, whole) = ([1.5 * a[1], -1.5 * a[0]], a.map(|part| -2.25 * part));
    let part = |of: [f64; 2], unit: [f64; 2]| of[0] * unit[0] + of[1] * unit[1];
    let (under, slip) = (part(speed, along), part(speed, across));
    // Its sense may be any.
    let omega = under.abs() / long;
    let coriolis = [-across[1], across[0]].map(|part| 2.0 * omega * slip * part);
    let alpha = (part(whole, across) - part(coriolis, across)) / long;
    let values = json!({
        "v(A@4)": vector(along.map(|part| part * under), "cm/s"),
        "slip(A/4)": vector(across.map(|part| part * slip), "cm/s"),
        "omega(4)": number(omega, "rad/s"), "coriolis(A/4)": vector(coriolis, "cm/s^2"),
        "alpha(4)": number(alpha, "rad/s^2"),
    });
    names(&scene, &values, Kind::PerpendicularForParallel, "v(A@4)");
}

/// Centres handed in for each other, and ω by a distance that is not that from the centre: one mark, and a name.
#[test]
fn typical_mistakes_with_centres_are_named() {
    let scene = r#"{
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [120, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 110 },
                   "4": { "joins": ["O4", "B"], "length": 80 } },
        "near": { "B": [120, 80] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
        "find": [{ "name": "I(1,3)", "method": "centres" }, { "name": "I(2,4)", "method": "centres" },
                 { "name": "omega(3)", "method": "centres" }, { "name": "v(B)", "method": "centres" }]
    }"#;
    let scene = linkgram::scene::read(scene, "scene.json").unwrap();
    // By hand: B from the two circles, I₁₃ where O₂A meets O₄B, I₂₄ where AB meets O₂O₄.
    let a = [20.0, 40.0 * libm::sin(std::f64::consts::FRAC_PI_3)];
    let [x, y] = [120.0 - a[0], -a[1]];
    let far = libm::hypot(x, y);
    let along = (far * far + 110.0 * 110.0 - 80.0 * 80.0) / (2.0 * far);
    let across = libm::sqrt(110.0 * 110.0 - along * along);
    let b = [a[0] + along * x / far - across * y / far, a[1] + along * y / far + across * x / far];
    let meet = |p: [f64; 2], d: [f64; 2], q: [f64; 2], e: [f64; 2]| {
        let t = ((q[0] - p[0]) * e[1] - (q[1] - p[1]) * e[0]) / (d[0] * e[1] - d[1] * e[0]);
        [p[0] + t * d[0], p[1] + t * d[1]]
    };
    let i13 = meet([0.0; 2], a, [120.0, 0.0], [b[0] - 120.0, b[1]]);
    let i24 = meet(a, [b[0] - a[0], b[1] - a[1]], [0.0; 2], [1.0, 0.0]);
    let away = |p: [f64; 2], q: [f64; 2]| libm::hypot(p[0] - q[0], p[1] - q[1]);
    // V_A = 400 mm/s; I₁₃ lies beyond A, so that link 3 turns clockwise.
    let omega = 400.0 / away(i13, a);
    let sense = if (i13[1] - a[1]) * a[1] > 0.0 { "cw" } else { "ccw" };
    let point = |at: [f64; 2]| serde_json::json!({ "components": at });
    let rate = |value: f64| serde_json::json!({ "value": value, "sense": sense });
    let first = |values: serde_json::Value| {
        let answers = serde_json::json!({ "values": values }).to_string();
        let answers = linkgram::grade::read_named(&answers, "answers.json", &scene).unwrap();
        let report =
            linkgram::grade::grade(&scene, &answers, &linkgram::grade::GradeSettings::default()).unwrap();
        let wrong = report.quantities.iter();
        let wrong = wrong.filter(|one| one.verdict == linkgram::grade::Verdict::Wrong).count();
        let first = report.first_fault().map(|fault| fault.mistakes.first().map_or("", |m| m.kind.name()));
        (first, wrong, report.to_text())
    };
    let right = serde_json::json!({ "I(1,3)": point(i13), "I(2,4)": point(i24), "omega(3)": rate(omega) });
    let (fault, _, text) = first(right);
    assert_eq!(fault, None, "{text}");
    let swapped = serde_json::json!({ "I(1,3)": point(i24), "I(2,4)": point(i13), "omega(3)": rate(omega) });
    let (fault, wrong, text) = first(swapped);
    assert_eq!((fault, wrong), (Some("interchanged"), 1), "{text}");
    let over_rod = serde_json::json!({ "I(1,3)": point(i13), "omega(3)": rate(400.0 / 110.0) });
    let (fault, wrong, text) = first(over_rod);
    assert_eq!((fault, wrong), (Some("wrong-formula"), 1), "{text}");
    // A wrong centre, and ω = V_A over the distance of A from it.
    let moved = [i13[0] + 25.0, i13[1] - 30.0];
    let own = serde_json::json!({ "I(1,3)": point(moved), "omega(3)": rate(400.0 / away(moved, a)) });
    let (_, wrong, text) = first(own);
    assert_eq!(wrong, 1, "{text}");
}

/// One direction that is off is no calculator in radians: that spoils all of them. The numbers of the four-bar are a lecturer's
/// own, from loop equations.
#[test]
fn one_wrong_direction_is_no_calculator_in_radians() {
    let scene = json!({
        "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [150, -20] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 55 },
            "3": { "joins": ["A", "B", "C"], "sides": [130, 85, 70], "turn": "ccw" },
            "4": { "joins": ["O4", "B"], "length": 95 },
        },
        "near": { "B": [140, 80] },
        "input": { "link": 2, "angle": 65, "omega": "12 rad/s cw", "alpha": "30 rad/s^2 ccw" },
        "find": ["v(B)", "v(C)", "omega(3)", "omega(4)", "a(B)", "a(C)", "alpha(3)", "alpha(4)"],
    });
    // By 4.2° a calculator in radians would be off in this one.
    for off in [4.2, 8.0, 12.0, 20.0, 45.0] {
        let values = json!({
            "v(B)": "544.1 mm/s at -0.5 deg",
            "v(C)": "517.9 mm/s at -20.1 deg",
            "omega(3)": "2.152 rad/s ccw",
            "omega(4)": "5.727 rad/s cw",
            "a(B)": format!("6853 mm/s^2 at {} deg", -153.4 + off),
            "a(C)": "8464 mm/s^2 at -140.2 deg",
            "alpha(3)": "27.69 rad/s^2 ccw",
            "alpha(4)": "64.25 rad/s^2 ccw",
        });
        let report = graded(&read(&scene), &json!({ "values": values }));
        let (kind, wrong) = told(&report);
        assert_eq!(wrong, ["a(B)"], "{}", report.to_text());
        assert_ne!(kind, Some(Kind::CalculatorInRadians), "{}", report.to_text());
    }
}
