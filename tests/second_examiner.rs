//! What a second examiner would not hand out: marks for nothing, a tolerance by the wrong scale, two penalties for one fault,
//! a misplaced pivot taken for a turned sheet, and answers that are refused for their spelling.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::grade::{GradeSettings, Kind, Report, Verdict, grade, read_answers, tolerances};
use linkgram::scene::{self, Scene};
use serde_json::{Value, json};

use crate::common::hand_in::{Closed, graded, right, slider};
use crate::common::read;

fn verdict(report: &Report, name: &str) -> Verdict {
    report.quantities.iter().find(|q| q.name == name).unwrap_or_else(|| panic!("no {name}")).verdict
}

fn first(report: &Report) -> Option<Kind> {
    Some(report.first_fault()?.mistakes.first()?.kind)
}

/// Whitworth's quick return: crank 20 cm at 150°, 1.5 rad/s clockwise, the lever's pivot 12 cm below.
fn whitworth(find: &[&str]) -> Scene {
    read(
        &json!({
            "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, -12] },
            "links": { "2": { "joins": ["O2", "A"], "length": 20 }, "4": { "joins": ["O4", "B"], "length": 20 },
                       "5": { "joins": ["B", "C"], "length": 65 } },
            "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } },
                        { "pin": "C", "block": 6, "on": { "link": 1, "through": [0, -12], "angle": 0 } } ],
            "near": { "B": [12, -28], "C": [-50, -12] },
            "input": { "link": 2, "angle": 150, "omega": "1.5 rad/s cw" }, "find": find
        })
        .to_string(),
    )
}

#[test]
fn nothing_is_worth_nothing() {
    let find = ["v(A@4)", "slip(A/4)", "omega(4)", "v(C)", "omega(5)", "coriolis(A/4)", "alpha(4)", "a(C)"];
    for (scene, asked) in
        [(slider(), &["v(B)", "omega(3)", "a(B)", "alpha(3)"][..]), (whitworth(&find), &find)]
    {
        for nothing in [json!(0), json!(1e-9)] {
            let values: serde_json::Map<String, Value> =
                asked.iter().map(|name| ((*name).to_owned(), nothing.clone())).collect();
            let report = graded(&scene, &json!({ "values": values }));
            assert_eq!(report.sum().0, 0.0, "{}", report.to_text());
            assert_ne!(first(&report), Some(Kind::ScaleInverted), "{}", report.to_text());
        }
    }
}

/// A centre is measured on the skeleton, whatever the scale of the velocities is.
#[test]
fn the_tolerance_of_a_centre_is_that_of_the_skeleton() {
    let room = |velocity: &str| {
        let scene = read(
            &json!({
                "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [45, 15] },
                "links": { "2": { "joins": ["O2", "A"], "length": 15 }, "3": { "joins": ["A", "B"], "length": 45 },
                           "4": { "joins": ["O4", "B"], "length": 30 } },
                "near": { "B": [52, -14] }, "input": { "link": 2, "angle": 30, "omega": "10 rad/s cw" },
                "find": ["I(1,3)", "v(B)"],
                "sheet": { "scales": { "length": "1:10", "velocity": velocity } }
            })
            .to_string(),
        );
        let all = tolerances(&scene, &GradeSettings::default()).unwrap();
        all.iter().find(|graded| graded.name == "I(1,3)").unwrap().tolerance
    };
    assert_eq!(room("1 cm/s per mm"), room("20 cm/s per mm"));
}

/// b lies on the line o a₄ in the ratio of the arms: whoever takes ∥ for ⊥ at a₄ and goes on so made one mistake.
#[test]
fn proportion_about_the_pivot_of_a_guide_is_a_right_way() {
    let at = 150_f64.to_radians();
    let pin = [20.0 * at.cos(), 20.0 * at.sin()];
    let arm = [pin[0], pin[1] + 12.0];
    let long = arm[0].hypot(arm[1]);
    let along = [arm[0] / long, arm[1] / long];
    let v = [1.5 * pin[1], -1.5 * pin[0]];
    // The part along the lever, taken for that of the lever.
    let part = v[0] * along[0] + v[1] * along[1];
    let under = [part * along[0], part * along[1]];
    let lever = [-20.0 / long * under[0], -20.0 / long * under[1]];
    let b = [-20.0 * along[0], -12.0 - 20.0 * along[1]];
    let rod = [-(65.0_f64.powi(2) - (b[1] + 12.0).powi(2)).sqrt(), -12.0 - b[1]];
    // V_C along the guide, V_CB across the rod.
    let rate = -lever[1] / rod[0];
    let slider = lever[0] - rate * rod[1];
    let vector = |v: [f64; 2]| json!({ "components": v.map(|x| format!("{x:.3} cm/s")) });
    let report = graded(
        &whitworth(&["v(A@4)", "v(C)", "omega(5)"]),
        &json!({ "values": { "v(A@4)": vector(under), "v(C)": vector([slider, 0.0]),
                             "omega(5)": format!("{:.4} rad/s {}", rate.abs(), if rate < 0.0 { "cw" } else { "ccw" }) } }),
    );
    assert_eq!(verdict(&report, "v(A@4)"), Verdict::Wrong, "{}", report.to_text());
    assert_eq!(verdict(&report, "v(C)"), Verdict::Consistent, "{}", report.to_text());
    assert_eq!(verdict(&report, "omega(5)"), Verdict::Consistent, "{}", report.to_text());
}

/// The second pivot stands 4 mm too low on paper, and all that follows is drawn rightly with it; nothing is turned.
#[test]
fn a_misplaced_pivot_is_no_turned_sheet() {
    let four_bar = |low: f64| {
        read(
            &json!({
                "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, -low] },
                "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 90 },
                           "4": { "joins": ["O4", "B"], "length": 70 } },
                "near": { "B": [95, 70] }, "input": { "link": 2, "angle": 70, "omega": "10 rad/s ccw" },
                "find": ["v(B)", "x(B)"], "sheet": { "scales": { "length": "1:1", "velocity": "5 mm/s per mm" } }
            })
            .to_string(),
        )
    };
    let (r, l, rocker, low): (f64, f64, f64, f64) = (40.0, 90.0, 70.0, 4.0);
    let at = 70_f64.to_radians();
    let a = [r * at.cos(), r * at.sin()];
    let pivot = [100.0, -low];
    // B by two circles, on the upper side.
    let base = [pivot[0] - a[0], pivot[1] - a[1]];
    let d = base[0].hypot(base[1]);
    let along = (d * d + l * l - rocker * rocker) / (2.0 * d);
    let high = (l * l - along * along).sqrt();
    let u = [base[0] / d, base[1] / d];
    let b = [a[0] + along * u[0] - high * u[1], a[1] + along * u[1] + high * u[0]];
    // V_A + ω₃ × AB is square to O4B.
    let va = [-10.0 * a[1], 10.0 * a[0]];
    let (ab, ob) = ([b[0] - a[0], b[1] - a[1]], [b[0] - pivot[0], b[1] - pivot[1]]);
    let omega = -(va[0] * ob[0] + va[1] * ob[1]) / (-ab[1] * ob[0] + ab[0] * ob[1]);
    let vb = [va[0] - omega * ab[1], va[1] + omega * ab[0]];
    let on_paper = |[x, y]: [f64; 2], scale: f64| json!([60.0 + x / scale, 70.0 + y / scale]);
    let report = graded(
        &four_bar(0.0),
        &json!({ "points": {
            "skeleton": { "O2": on_paper([0.0; 2], 1.0), "O4": on_paper(pivot, 1.0), "A": on_paper(a, 1.0),
                          "B": on_paper(b, 1.0) },
            "velocity": { "o": on_paper([0.0; 2], 5.0), "a": on_paper(va, 5.0), "b": on_paper(vb, 5.0) } } }),
    );
    assert_eq!(report.turned, None, "{}", report.to_text());
    assert_eq!(verdict(&report, "skeleton:A"), Verdict::Right, "{}", report.to_text());
    assert_eq!(first(&report), Some(Kind::PivotMisplaced), "{}", report.to_text());
    assert_ne!(verdict(&report, "velocity:b"), Verdict::Wrong, "{}", report.to_text());
}

/// The piston's force with the bore taken as a radius is four times too large, and so is all that follows.
#[test]
fn a_wrong_load_costs_its_own_mark() {
    let (r, l, at): (f64, f64, f64) = (50.0, 200.0, 40_f64.to_radians());
    let scene = read(
        &json!({
            "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
            "links": { "2": { "joins": ["O2", "A"], "length": r }, "3": { "joins": ["A", "B"], "length": l } },
            "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } } ],
            "near": { "B": [245, 0] }, "input": { "link": 2, "angle": 40, "omega": "1000 rpm ccw" },
            "loads": [ { "name": "P", "on": 4, "at": "B", "pressure": "18 bar", "bore": 80, "direction": 180 } ],
            "find": ["load(P)", "F(3,4)", "F(1,4)", "T(2)"]
        })
        .to_string(),
    );
    // By statics: the rod leans by β, sin β = r sin θ / l.
    let load = 1.8e6 * std::f64::consts::PI * 0.08 * 0.08;
    let lean = (r * at.sin() / l).asin();
    let rod = load / lean.cos();
    let guide = load * lean.tan();
    let torque = rod * 0.05 * (at + lean).sin();
    let polar =
        |size: f64, degrees: f64| json!({ "magnitude": format!("{size:.0} N"), "direction": degrees });
    let report = graded(
        &scene,
        &json!({ "values": { "load(P)": polar(load, 180.0), "F(3,4)": polar(rod, -lean.to_degrees()),
                             "F(1,4)": polar(guide, 90.0), "T(2)": format!("{torque:.1} N*m cw") } }),
    );
    assert_eq!(first(&report), Some(Kind::DiameterForRadius), "{}", report.to_text());
    for name in ["F(3,4)", "F(1,4)", "T(2)"] {
        assert_eq!(verdict(&report, name), Verdict::Consistent, "{}", report.to_text());
    }
}

#[test]
fn a_ratio_the_other_way_up_and_two_figures_have_their_names() {
    let scene = read(
        &json!({
            "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
            "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
            "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ],
            "near": { "B": [58, 0] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
            "find": ["ratio(3/2)", "v(A)"]
        })
        .to_string(),
    );
    let ratio = right().omega / 10.0;
    let report = graded(&scene, &json!({ "values": { "ratio(3/2)": format!("{:.3}", 1.0 / ratio) } }));
    assert_eq!(first(&report), Some(Kind::RatioInverted), "{}", report.to_text());
    // (-259.8, 150) cm/s.
    let report =
        graded(&scene, &json!({ "values": { "v(A)": { "components": ["-260 cm/s", "150 cm/s"] } } }));
    assert!(report.holds(), "{}", report.to_text());
    let answers = json!({ "values": { "v(B)": "350 cm/s", "omega(3)": "3.5 rad/s cw", "a(B)": "650 cm/s^2",
                                      "alpha(3)": format!("{:.0} rad/s^2 cw", right().alpha.abs()) } });
    let report = graded(&slider(), &answers);
    assert!(report.quantities.iter().all(|q| q.mistakes.iter().all(|m| m.kind != Kind::CalculatorInRadians)));
}

/// ω of one link with a minus sign says that signs are senses: the others are counter-clockwise.
#[test]
fn a_minus_sign_makes_a_plus_a_sense() {
    let Closed { omega, alpha, .. } = right();
    // Clockwise the one, counter-clockwise the other.
    assert!(omega < 0.0 && alpha > 0.0);
    let report = graded(&slider(), &json!({ "values": { "omega(3)": -omega } }));
    assert_eq!(verdict(&report, "omega(3)"), Verdict::Right, "a magnitude: {}", report.to_text());
    let report = graded(&slider(), &json!({ "values": { "omega(3)": -omega, "alpha(3)": -alpha } }));
    assert_eq!(verdict(&report, "omega(3)"), Verdict::Wrong, "{}", report.to_text());
    // The other way to close the chain has both senses: what follows from that is counted.
    assert_ne!(verdict(&report, "alpha(3)"), Verdict::Right, "{}", report.to_text());
}

#[test]
fn answers_are_read_as_they_are_spelt_on_the_sheet_and_empty_ones_are_not_answered() {
    let Closed { omega, speed, .. } = right();
    for [rate, velocity] in [["omega(3)", "v(B)"], ["ω₃", "V_B"], ["omega3", "v_B"], ["ω3", "vB"]] {
        let values = json!({ rate: format!("{omega:.3} rad/s"), velocity: format!("{:.1} cm/s", -speed),
                             "a(B)": "", "alpha(3)": null });
        let report = graded(&slider(), &json!({ "values": values }));
        assert_eq!(report.quantities.len(), 2, "{}", report.to_text());
        assert!(report.holds() && report.missing.len() == 2, "{}", report.to_text());
        let table = format!(
            "quantity;value;unit;sense\n{rate};{:.3};rad/s;cw\n;;;\n{velocity};{:.1};cm/s;\n",
            -omega, -speed
        );
        for table in [table.clone(), table.replace(';', "\t"), table.replace('.', ",")] {
            let answers = read_answers(&table, &slider()).unwrap();
            let report = grade(&slider(), &answers, &GradeSettings::default()).unwrap();
            assert_eq!(report.quantities.len(), 2, "{table}");
            assert!(report.holds(), "{table}{}", report.to_text());
        }
    }
    assert!(scene::read("{}", "none").is_err());
}

/// α₄ of this scene is small beside what its polygon is made of: whoever asks is told so beforehand, and who draws with
/// care does not lose its mark.
#[test]
fn what_nobody_can_measure_costs_no_careful_hand_a_mark() {
    let scene = whitworth(&["omega(4)", "alpha(4)"]);
    let strict = GradeSettings { max_tolerance: 0.02, ..GradeSettings::default() };
    let one = |settings: &GradeSettings, part: f64| {
        let asked = tolerances(&scene, settings).unwrap();
        let alpha = asked.iter().find(|graded| graded.name == "alpha(4)").unwrap();
        let value = alpha.right[0] * (1.0 + part);
        let answers = json!({ "values": { "alpha(4)": format!("{value:.5} rad/s^2") } });
        let answers = read_answers(&answers.to_string(), &scene).unwrap();
        let report = grade(&scene, &answers, settings).unwrap();
        let graded = report.quantities[0].clone();
        assert!(graded.tolerance <= settings.max_tolerance * alpha.right[0].abs() * 1.001, "{graded:?}");
        (graded.verdict, graded.beyond)
    };
    let usual = GradeSettings::default();
    assert_eq!(one(&usual, 0.03), (Verdict::Right, false));
    assert_eq!(one(&usual, 0.11), (Verdict::Right, true));
    assert_eq!(one(&usual, 0.6), (Verdict::Wrong, false));
    // A stricter cap is meant as it is stated.
    assert_eq!(one(&strict, 0.03).0, Verdict::Wrong);
}
