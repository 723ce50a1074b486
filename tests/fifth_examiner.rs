//! What a fifth examiner would not hand out: a slip of the hand that is given the name of a mistake, a fit with as many free
//! numbers as there are data, a cap that is passed without a word, and a figure that leaves half of an exchange out.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::f64::consts::PI;

use linkgram::grade::{
    Allowed, GradeSettings, Kind, Report, Verdict, grade_with_overlay, read_answers, tolerances,
};
use linkgram::scene::{self, Scene};
use linkgram::sheet::figure::{Node, Shape};
use serde_json::{Value, json};

use crate::common::hand_in::{SLIDER, graded, right, slider};

fn polar(size: f64, degrees: f64, unit: &str) -> Value {
    json!({ "magnitude": format!("{size:.2} {unit}"), "direction": degrees })
}

fn kinds(report: &Report) -> Vec<Kind> {
    report.quantities.iter().filter_map(|graded| graded.mistakes.first()).map(|first| first.kind).collect()
}

/// A slider-crank with the rod's centre: one magnitude or direction of it, and what is calculated from it, off by a slip.
#[test]
fn a_small_slip_is_called_a_slip() {
    let scene = slider();
    let own = right();
    let by = |slip: f64| {
        json!({ "values": {
            "v(B)": polar(own.speed.abs(), 180.0, "cm/s"), "omega(3)": format!("{:.3} rad/s cw", own.omega.abs()),
            "a(B)": polar(own.acceleration.abs() * slip, 180.0, "cm/s^2"),
            "alpha(3)": format!("{:.2} rad/s^2 {}", own.alpha.abs(), if own.alpha > 0.0 { "ccw" } else { "cw" }),
        }})
    };
    for (slip, told) in [(1.11, "11 % too large"), (0.89, "11 % too small")] {
        let report = graded(&scene, &by(slip));
        let text = report.to_text();
        assert!(kinds(&report).is_empty(), "{text}");
        assert!(text.contains(told), "{text}");
        let wrong = report.quantities.iter().filter(|graded| graded.verdict == Verdict::Wrong).count();
        assert_eq!(wrong, 1, "{text}");
    }
}

/// Crank 80 mm at 45°, rod 300 mm, 2 kN on the piston. The rod's force slips; guide and torque follow from it: by the polygon of
/// the piston, and by moments about O2. Any pivot could be moved so that it fits.
#[test]
fn a_wrong_force_is_not_explained_by_two_free_numbers() {
    let (crank, rod, angle) = (0.08_f64, 0.3_f64, 45_f64.to_radians());
    let lean = (crank * angle.sin() / rod).asin();
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 300 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } }],
        "near": { "B": [350, 0] }, "input": { "link": 2, "angle": 45, "omega": "300 rpm ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 2000, "direction": 180 }],
        "find": ["F(3,4)", "F(1,4)", "F(2,3)", "T(2)"]
    });
    let scene = scene::read(&scene.to_string(), "engine.json").unwrap();
    for (slip, turned) in [(1.25, 0.0), (0.8, 7.0), (1.3, 10.0)] {
        let force = slip * 2000.0 / lean.cos();
        let direction = -lean + f64::to_radians(turned);
        let [x, y] = [force * direction.cos(), force * direction.sin()];
        // From rod to crank it acts backwards; the torque holds it about O2.
        let pin = [crank * angle.cos(), crank * angle.sin()];
        let torque = pin[0] * y - pin[1] * x;
        let values = json!({
            "F(3,4)": { "components": [x, y], "unit": "N" }, "F(1,4)": { "components": [2000.0 - x, -y], "unit": "N" },
            "F(2,3)": { "components": [x, y], "unit": "N" },
            "T(2)": format!("{:.2} N*m {}", torque.abs(), if torque > 0.0 { "ccw" } else { "cw" }),
        });
        let report = graded(&scene, &json!({ "values": values }));
        let fitted = [Kind::PivotMisplaced, Kind::PointLaidOff, Kind::GuideMisplaced];
        assert!(!kinds(&report).iter().any(|kind| fitted.contains(kind)), "{}", report.to_text());
    }
}

/// The input read as 210 for 120 rpm: velocities 1.75 times, accelerations 1.75² times as large.
#[test]
fn two_digits_of_a_speed_interchanged_are_named() {
    let scene = SLIDER.replace("10 rad/s ccw", "120 rpm ccw");
    let scene = scene::read(&scene, "slider.json").unwrap();
    let own = right();
    let faster = 210.0 * PI / 30.0 / 10.0;
    let sense = |value: f64| if value > 0.0 { "ccw" } else { "cw" };
    let values = json!({
        "v(B)": polar(own.speed.abs() * faster, 180.0, "cm/s"),
        "omega(3)": format!("{:.3} rad/s {}", own.omega.abs() * faster, sense(own.omega)),
        "a(B)": polar(own.acceleration.abs() * faster * faster, 180.0, "cm/s^2"),
        "alpha(3)": format!("{:.1} rad/s^2 {}", own.alpha.abs() * faster * faster, sense(own.alpha)),
    });
    let report = graded(&scene, &json!({ "values": values }));
    assert_eq!(kinds(&report), [Kind::InputSpeed], "{}", report.to_text());
    assert!(report.to_text().contains("210 for 120"), "{}", report.to_text());
}

/// Values as the sheet prints them.
#[test]
fn the_sign_of_an_angle_is_read() {
    let own = right();
    let answers = json!({ "values": {
        "v(B)": format!("{:.1} cm/sec ∠180°", own.speed.abs()),
        "a(B)": format!("{:.1} cm/s^2 ∠ 180 degrees", own.acceleration.abs()),
    }});
    let report = graded(&slider(), &answers);
    assert!(report.quantities.iter().all(|graded| graded.verdict == Verdict::Right), "{}", report.to_text());
}

fn four_bar() -> Scene {
    let scene = json!({
        "units": { "length": "in" }, "fixed": { "O2": [0, 0], "O4": [7, 1] },
        "links": { "2": { "joins": ["O2", "A"], "length": 2.5 }, "3": { "joins": ["A", "B", "C"], "arms": [6, 4, 35] },
                   "4": { "joins": ["O4", "B"], "length": 5 } },
        "near": { "B": [5.5, 6] },
        "input": { "link": 2, "angle": 115, "omega": "120 rpm cw", "alpha": "40 rad/s^2 cw" },
        "find": ["v(B)", "omega(3)", "omega(4)"]
    });
    scene::read(&scene.to_string(), "four-bar.json").unwrap()
}

/// ω of a coupler that hardly turns may be off by more than the cap: that is said, with the reason.
#[test]
fn a_cap_that_does_not_hold_is_told() {
    let all = tolerances(&four_bar(), &GradeSettings::default()).unwrap();
    for graded in all {
        let part = graded.tolerance / graded.right.iter().fold(0.0, |sum: f64, n| sum.hypot(*n));
        let small = matches!(graded.allowed, Allowed::Small { .. });
        let capped = matches!(graded.allowed, Allowed::Capped { .. });
        assert_eq!(part > 0.1 + 1e-9, small || capped && part > 0.1 + 1e-9, "{} {part}", graded.name);
        if graded.name == "omega(3)" {
            assert!(small && graded.because().to_string().contains("does not hold"), "{}", graded.because());
        }
    }
}

/// Of two centres interchanged both are shown where the student has them.
#[test]
fn both_of_two_centres_interchanged_are_shown() {
    let scene = json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [18, -2], "O6": [40, 3] },
        "links": { "2": { "joins": ["O2", "A"], "length": 6 }, "3": { "joins": ["A", "B"], "length": 17 },
                   "4": { "joins": ["O4", "B", "D"], "sides": [11, 7, 13], "turn": "cw" },
                   "5": { "joins": ["D", "E"], "length": 19 }, "6": { "joins": ["O6", "E"], "length": 10 } },
        "near": { "B": [16, 9], "D": [22, 11], "E": [39, 14] },
        "input": { "link": 2, "angle": 70, "omega": "5 rad/s ccw" },
        "find": ["I(1,3)", "I(1,5)"]
    });
    let scene = scene::read(&scene.to_string(), "six-link.json").unwrap();
    // Each under the other's name.
    let right = tolerances(&scene, &GradeSettings::default()).unwrap();
    let at = |index: usize| json!({ "components": right[index].right, "unit": "cm" });
    let answers = json!({ "values": { "I(1,3)": at(1), "I(1,5)": at(0) } });
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let (_, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
    let mut own = 0;
    figure.unwrap().root.walk(&mut |node| {
        if let Node::Mark(mark) = node {
            own += usize::from(mark.class == "student" && matches!(mark.shape, Shape::Circle { .. }));
        }
    });
    assert_eq!(own, 2);
}

/// On a printed page nothing is wider than the paper, and the letters are as large as on the sheet.
#[test]
fn a_printed_overlay_is_no_wider_than_the_page() {
    let own = right();
    let answers = json!({ "values": {
        "v(B)": polar(own.speed.abs() * 3.0, 180.0, "cm/s"), "a(B)": polar(own.acceleration.abs() * 2.4, 0.0, "cm/s^2"),
    }});
    let scene = slider();
    let answers = read_answers(&answers.to_string(), &scene).unwrap();
    let drawn = |printed: bool| {
        let settings = GradeSettings { printed, ..GradeSettings::default() };
        grade_with_overlay(&scene, &answers, &settings).unwrap().1.unwrap()
    };
    let smallest = |figure: &linkgram::sheet::Figure| {
        let mut smallest = f64::INFINITY;
        figure.root.walk(&mut |node| {
            if let Node::Text(text) = node {
                smallest = text.runs.iter().map(|run| run.size).fold(smallest, f64::min);
            }
        });
        smallest
    };
    let (sheet, page) = (drawn(false), drawn(true));
    assert!(sheet.width > 190.0 && page.width < 190.0, "{} {}", sheet.width, page.width);
    assert!(smallest(&page) >= smallest(&sheet));
    assert!(!linkgram::sheet::strips(&page).is_empty());
}

/// A block pulled to the left along a rough guide against 2 kN: crank 60 mm at 125°, rod 200 mm, by the triangle of its
/// forces. The rod pulls with S, the guide presses down with S·sin λ and leans by f to the right.
fn press(f: f64) -> ([f64; 2], [f64; 2], f64) {
    let (crank, rod, angle) = (0.06_f64, 0.2_f64, 125_f64.to_radians());
    let pin = [crank * angle.cos(), crank * angle.sin()];
    let lean = (pin[1] / rod).asin();
    let pull = 2000.0 / (lean.cos() - f * lean.sin());
    let along = [-pull * lean.cos(), pull * lean.sin()];
    ([f * pull * lean.sin(), -pull * lean.sin()], along, pin[0] * along[1] - pin[1] * along[0])
}

fn rough_press() -> Scene {
    let scene = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 200 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" }, "f": 0.15 }],
        "near": { "B": [160, 0] }, "input": { "link": 2, "angle": 125, "omega": "1 rad/s ccw" },
        "masses": { "4": { "mass": 25 } },
        "loads": [{ "on": 4, "at": "B", "force": 2000, "direction": 0 }],
        "find": ["F(1,4)", "F(3,4)", "F(2,3)", "T(2)"]
    });
    scene::read(&scene.to_string(), "press.json").unwrap()
}

fn newtons(force: [f64; 2]) -> Value {
    json!({ "components": force, "unit": "N" })
}

/// Another coefficient of friction is told by the force of the guide; no velocity is named where none is handed in.
#[test]
fn in_statics_no_velocities_are_accused() {
    let scene = rough_press();
    for f in [0.25, 0.3, 0.5] {
        let (guide, along, torque) = press(f);
        let report = graded(
            &scene,
            &json!({ "values": {
                "F(1,4)": newtons(guide), "F(3,4)": newtons(along), "F(2,3)": newtons(along),
                "T(2)": format!("{torque:.2} N*m"),
            }}),
        );
        assert_eq!(kinds(&report), [Kind::FrictionMisread], "{}", report.to_text());
    }
    for slip in [0.9, 1.02, 1.05, 1.2] {
        let (guide, along, torque) = press(0.15);
        let report = graded(
            &scene,
            &json!({ "values": {
                "F(1,4)": newtons(guide), "F(3,4)": newtons(along.map(|part| slip * part)),
                "F(2,3)": newtons(along), "T(2)": format!("{torque:.2} N*m"),
            }}),
        );
        let text = report.to_text();
        assert!(!text.contains("velocit") && !text.contains("acceleration"), "{text}");
    }
}

/// The direction of one force alone is a slip, not another coefficient of friction.
#[test]
fn one_leaning_force_tells_no_coefficient() {
    let (guide, along, torque) = press(0.15);
    for degrees in [4.0_f64, 5.0, -4.0] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let own = [cos * guide[0] - sin * guide[1], sin * guide[0] + cos * guide[1]];
        let report = graded(
            &rough_press(),
            &json!({ "values": {
                "F(1,4)": newtons(own), "F(3,4)": newtons(along), "F(2,3)": newtons(along),
                "T(2)": format!("{torque:.2} N*m"),
            }}),
        );
        assert!(!kinds(&report).contains(&Kind::FrictionMisread), "{}", report.to_text());
    }
}

fn wheel() -> Scene {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] }, "placed": { "C": [0, 80] },
        "links": { "2": { "joins": ["C", "P"], "length": 80 }, "3": { "joins": ["P", "Q"], "length": 260 } },
        "rolls": [{ "links": [2, 1], "centre": "C", "radius": 80, "line": { "link": 1, "through": "O", "angle": 0 } }],
        "slides": [{ "pin": "Q", "block": 4, "on": { "link": 1, "through": [0, 50] } }],
        "near": { "Q": [300, 50] },
        "input": { "link": 2, "angle": 40, "omega": "6 rad/s cw", "alpha": "10 rad/s^2 cw" },
        "find": ["v(C)", "v(P)", "v(Q)", "omega(3)", "a(P)", "a(Q)", "alpha(3)"]
    });
    scene::read(&scene.to_string(), "wheel.json").unwrap()
}

/// V_P too large, and V_Q and ω₃ found from it; V_C in the same diagram is right. V_P = ω·2r·cos 25°, by the point of contact.
#[test]
fn a_scale_holds_for_every_vector_of_its_diagram() {
    let (radius, rod, omega) = (80.0_f64, 260.0_f64, 6.0_f64);
    let half = 25_f64.to_radians();
    let lean = ((radius * (1.0 + 40_f64.to_radians().sin()) - 50.0) / rod).asin();
    for slip in [1.07, 1.1, 0.92] {
        let speed = slip * omega * 2.0 * radius * half.cos();
        let across = speed * (half - lean).cos() / lean.cos();
        let report = graded(
            &wheel(),
            &json!({ "values": {
                "v(C)": polar(omega * radius, 0.0, "mm/s"), "v(P)": polar(speed, -25.0, "mm/s"),
                "v(Q)": polar(across, 0.0, "mm/s"),
            }}),
        );
        assert!(!kinds(&report).contains(&Kind::ScaleWrong), "{}", report.to_text());
    }
}

/// All numbers of a wheel twice as large: what explains a late answer alone does not lie in the skeleton from which the
/// earlier ones are found as well.
#[test]
fn a_guide_is_not_accused_after_what_nothing_explains() {
    let report = graded(
        &wheel(),
        &json!({ "values": {
            "v(C)": "960.0 mm/s at 0.0 deg", "v(P)": "1740 mm/s at -25.0 deg", "v(Q)": "2625 mm/s at 0.0 deg",
            "omega(3)": "4.925 rad/s ccw", "a(P)": "5241 mm/s^2 at -109.9 deg", "a(Q)": "5740 mm/s^2 at 180.0 deg",
            "alpha(3)": "1.571 rad/s^2 cw",
        }}),
    );
    assert!(!kinds(&report).contains(&Kind::GuideMisplaced), "{}", report.to_text());
}

/// A torque that is wrong shows in no polygon: none is laid out as if it did.
#[test]
fn what_shows_in_no_figure_has_no_overlay() {
    let text = json!({
        "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 200 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
        "near": { "B": [240, 0] }, "input": { "link": 2, "angle": 60, "omega": "300 rpm ccw" },
        "masses": { "4": { "mass": 2 } },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 2000, "direction": 180 }],
        "find": ["a(B)", "T(2)"]
    });
    let scene = scene::read(&text.to_string(), "engine.json").unwrap();
    let right = tolerances(&scene, &GradeSettings::default()).unwrap();
    let own = |name: &str| right.iter().find(|graded| graded.name == name).unwrap().right.clone();
    for (times, shown) in [(1.0, true), (1.25, false)] {
        let answers = json!({ "values": {
            "a(B)": { "components": own("a(B)"), "unit": "mm/s^2" },
            "T(2)": format!("{} N*m", times * own("T(2)")[0]),
        }});
        let answers = read_answers(&answers.to_string(), &scene).unwrap();
        let (report, figure) = grade_with_overlay(&scene, &answers, &GradeSettings::default()).unwrap();
        assert_eq!(figure.is_some(), shown, "{}", report.to_text());
    }
}

/// The questions of an examination say on which body a force acts whose direction brings marks.
#[test]
fn a_question_says_on_which_body_a_force_acts() {
    use linkgram::sheet::{Language, Part, prompt};
    let scene = rough_press();
    for (language, force, torque) in [
        (Language::English, "the force of link 1 on link 4", "the torque on link 2"),
        (Language::Arabic, "القوة المؤثرة من الوصلة 1 في الوصلة 4", "العزم المؤثر في الوصلة 2"),
        (Language::Persian, "نیروی بند 1 بر بند 4", "گشتاور وارد بر بند 2"),
    ] {
        let asked = &scene.mechanism.asked;
        let told = |index: usize, part| prompt(&scene, &asked[index], part, language);
        assert!(told(0, Part::Magnitude).contains(force), "{}", told(0, Part::Magnitude));
        assert!(!told(0, Part::Direction).contains(force));
        assert!(told(3, Part::Value).contains(torque), "{}", told(3, Part::Value));
        let mut said = String::new();
        linkgram::exam::card(&scene, language).unwrap().root.walk(&mut |node| {
            if let Node::Text(text) = node {
                said.extend(text.runs.iter().map(|run| run.text.as_str()));
                said.push('\n');
            }
        });
        assert!(said.contains("F14"), "{said}");
    }
}
