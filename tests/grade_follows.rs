//! An answer that follows from the student's own earlier answers by any right way has its mark, and a mistake costs one
//! mark in whatever form it is handed in. The numbers are those of complex-number kinematics of their own, not of the
//! program: what comes after a mistake is calculated from it.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use linkgram::grade::{GradeSettings, Report, Verdict, grade, read_named};
use serde_json::{Value, json};

fn graded(scene: &Value, answers: &Value) -> Report {
    let scene = linkgram::scene::read(&scene.to_string(), "scene.json").unwrap();
    let answers = read_named(&answers.to_string(), "answers.json", &scene).unwrap();
    grade(&scene, &answers, &GradeSettings::default()).unwrap()
}

/// The marks of one hand-in, and that nothing but these answers is wrong.
fn wrong_alone(mechanism: fn(&[&str]) -> Value, values: &Value, wrong: &[&str]) {
    let names: Vec<&str> = values.as_object().unwrap().keys().map(String::as_str).collect();
    let report = graded(&mechanism(&names), &json!({ "values": values }));
    let found: Vec<&str> = report
        .quantities
        .iter()
        .filter(|graded| graded.verdict == Verdict::Wrong)
        .map(|graded| graded.name.as_str())
        .collect();
    assert_eq!(found, wrong, "{}", report.to_text());
}

fn vector(magnitude: f64, direction: f64) -> Value {
    json!({ "magnitude": magnitude, "direction": direction })
}

fn turning(value: f64, sense: &str) -> Value {
    json!({ "value": value, "sense": sense })
}

fn shaper(find: &[&str]) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, -32] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 15 }, "4": { "joins": ["O4", "B"], "length": 62 },
            "5": { "joins": ["B", "C"], "length": 24 }
        },
        "slides": [
            { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } },
            { "pin": "C", "block": 6, "on": { "link": 1, "through": [0, 28], "angle": 0 } }
        ],
        "near": { "B": [20, 25], "C": [-10, 28] },
        "input": { "link": 2, "angle": 20, "omega": "8 rad/s cw" }, "find": find
    })
}

fn six_links(find: &[&str]) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [60, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 20 }, "3": { "joins": ["A", "B"], "length": 55 },
            "4": { "joins": ["O4", "B", "C"], "arms": [40, 30, -60] }, "5": { "joins": ["C", "D"], "length": 60 }
        },
        "slides": [{ "pin": "D", "block": 6, "on": { "link": 1, "through": [110, 0], "angle": 90 } }],
        "near": { "B": [70, 40], "D": [110, -20] },
        "input": { "link": 2, "angle": 70, "omega": "10 rad/s ccw" }, "find": find
    })
}

fn coupler(find: &[&str]) -> Value {
    json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [25, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 8 }, "3": { "joins": ["A", "B", "C"], "arms": [26, 14, 35] },
            "4": { "joins": ["O4", "B"], "length": 16 }
        },
        "near": { "B": [20, 18] },
        "input": { "link": 2, "angle": 125, "omega": "12 rad/s cw", "alpha": "40 rad/s^2 ccw" }, "find": find
    })
}

fn crank_and_rocker(find: &[&str]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [180, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 150 },
            "4": { "joins": ["O4", "B"], "length": 110 }
        },
        "near": { "B": [150, 110] },
        "input": { "link": 2, "angle": 60, "omega": "120 rpm ccw" }, "find": find
    })
}

/// 900 N m at 60°, 300 at 120°, nothing from 180° to the end of the turn; 400 kg at 500 mm turn.
fn turning_moment(find: &[&str]) -> Value {
    let table = json!([[0, 0], [60, 900], [120, 300], [180, 0], [360, 0]]);
    json!({
        "links": {}, "input": { "omega": "300 rpm" },
        "cycle": { "torque": { "table": table }, "rotating": [{ "mass": 400, "gyration": "500 mm" }] },
        "find": find
    })
}

fn gas_engine(find: &[&str]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 80 }, "3": { "joins": ["A", "B"], "length": 300 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 0 } }],
        "near": { "B": [350, 0] }, "input": { "link": 2, "angle": 45, "omega": "300 rpm ccw" },
        "loads": [{ "on": 4, "at": "B", "force": 2000, "direction": 180 }], "find": find
    })
}

#[test]
fn the_solutions_own_steps_lead_on_from_own_answers() {
    // V_B is that of A on the lever; the rod and ε of the rod are drawn rightly from it, A_B is right.
    let rod = json!({
        "v(B)": vector(78.39, -20.8), "v(C)": vector(75.66, 0.0), "a(B)": vector(623.5, -178.0),
        "alpha(5)": turning(1.028, "cw")
    });
    wrong_alone(shaper, &rod, &["v(B)"]);
    // ω₄ from V_BA; V_D, A_D, ε₄ and ε₅ from it.
    let rocker = json!({
        "v(D)": vector(68.58, 90.0), "omega(4)": turning(2.104, "ccw"), "a(D)": vector(1233.0, 90.0),
        "alpha(4)": turning(37.7, "ccw"), "alpha(5)": turning(13.63, "ccw")
    });
    wrong_alone(six_links, &rocker, &["omega(4)"]);
    // V_C by the inverse ratio.
    let ratio = json!({ "v(C)": vector(207.8, 123.4), "v(D)": vector(225.8, 90.0), "alpha(5)": turning(19.26, "ccw") });
    wrong_alone(six_links, &ratio, &["v(C)"]);
}

#[test]
fn a_point_of_a_link_follows_from_own_rates() {
    // V_C = V_A + ω₃ × AC with the student's ω₃, in the wrong sense and of the wrong size; V_B is read off the polygon.
    let [a, b] = [vector(96.0, 35.0), vector(92.46, 18.4)];
    let sense =
        json!({ "v(A)": a, "v(B)": b, "omega(3)": turning(1.053, "ccw"), "v(C)": vector(92.17, 43.7) });
    wrong_alone(coupler, &sense, &["omega(3)"]);
    let size = json!({ "v(A)": a, "v(B)": b, "omega(3)": turning(3.556, "cw"), "v(C)": vector(121.9, 12.3) });
    wrong_alone(coupler, &size, &["omega(3)"]);
    // What follows from nothing stays wrong.
    let neither =
        json!({ "v(A)": a, "v(B)": b, "omega(3)": turning(3.556, "cw"), "v(C)": vector(150.0, 70.0) });
    wrong_alone(coupler, &neither, &["omega(3)", "v(C)"]);
}

#[test]
fn numbers_of_a_turning_moment_diagram_follow_from_own_ones() {
    // P = T·ω, K_s = E_f/(I·ω²).
    wrong_alone(turning_moment, &json!({ "Tmean": 400.0, "power": 12570.0 }), &["Tmean"]);
    wrong_alone(turning_moment, &json!({ "Ef": 698.1, "Ks": 0.007074 }), &["Ef"]);
    wrong_alone(turning_moment, &json!({ "Ef": 698.1, "Ks": 0.0085 }), &["Ef", "Ks"]);
}

fn press(find: &[&str]) -> Value {
    let table =
        json!([[0, 100], [50, 900], [120, 700], [180, 120], [240, -100], [290, 650], [330, 500], [360, 100]]);
    json!({
        "units": { "torque": "N*m" }, "links": {}, "input": { "omega": "240 rpm" },
        "cycle": { "torque": { "table": table }, "fluctuation": 0.03,
                   "rotating": [{ "mass": 120, "gyration": "300 mm" }] },
        "find": find
    })
}

#[test]
fn a_turning_moment_diagram_is_cut_at_the_students_own_mean() {
    // By hand on the given table with T = 380 N m: θ₁ = (380 − 100)/800·50°, E_min at it −280·0.3054/2, and so on.
    let low = json!({
        "E": 2390.0, "Tmean": 380.0, "power": 9550.0, "crossing(1)": 17.5, "crossing(2)": 153.0, "Emax": 710.0,
        "Emin": -42.8, "Ef": 753.0, "Ke": 0.315, "If": 28.9
    });
    wrong_alone(press, &low, &["E"]);
    // The mean over two turns; E itself is right.
    let two_turns = json!({
        "E": 2650.0, "Tmean": 211.0, "power": 5300.0, "crossing(1)": 6.94, "crossing(2)": 171.0,
        "Emax": 1330.0, "Emin": -6.73, "Ef": 1340.0, "Ke": 0.506, "If": 60.0
    });
    wrong_alone(press, &two_turns, &["Tmean"]);
    // T = 427 N m is within its room and moves the small level by more than that has.
    wrong_alone(press, &json!({ "Tmean": 427.0, "Emin": -95.7 }), &[]);
    wrong_alone(press, &json!({ "Tmean": 427.0, "Emin": -125.0 }), &["Emin"]);
    wrong_alone(press, &json!({ "Tmean": 380.0, "crossing(1)": 30.0 }), &["Tmean", "crossing(1)"]);
}

#[test]
fn mistakes_of_a_flywheel_are_named() {
    // K_s·ω² = 18.95, I = 10.8 kg m², E_f = 672.5 J, E_max = 599.4 J.
    let flywheel = |values: Value| named(&press(&["Tmean", "E", "Emax", "Emin", "Ef", "Ke", "If"]), &values);
    let right =
        json!({ "Tmean": 422.1, "E": 2652.0, "Emax": 599.4, "Emin": -73.05, "Ef": 672.5, "Ke": 0.2536 });
    let with = |name: &str, value: f64| {
        let mut values = right.clone();
        values[name] = json!(value);
        values
    };
    let expected = [
        (with("If", 672.5 / 18.95), "wrong-formula"),
        (with("If", 672.5 / 18.95 + 10.8), "wrong-formula"),
        (with("If", 672.5 / (2.0 * 18.95) - 10.8), "half-fluctuation"),
        (with("If", 672.5 / 18.95 - 36.0), "wrong-formula"),
        (with("Ke", 672.5 / 422.1), "wrong-formula"),
    ];
    for (values, kind) in expected {
        assert_eq!(flywheel(values.clone()).0, kind, "{values}");
    }
    let level = json!({ "Emax": 599.4, "Emin": -73.05, "Ef": 599.4 });
    assert_eq!(named(&press(&["Emax", "Emin", "Ef"]), &level), ("wrong-formula", 1.0));
    let mean = json!({ "E": 2652.0, "Tmean": 211.0, "crossing(1)": 6.94 });
    assert_eq!(named(&press(&["E", "Tmean", "crossing(1)"]), &mean), ("one-turn-for-two", 1.0));
    // −100 N m read as 100 N m: E by trapezia over the other table.
    let sign = json!({ "E": 2844.0, "Tmean": 452.6, "crossing(1)": 22.04, "crossing(2)": 145.6, "Emax": 520.9,
                       "Emin": -67.82, "Ef": 588.8 });
    let find = ["E", "Tmean", "crossing(1)", "crossing(2)", "Emax", "Emin", "Ef"];
    assert_eq!(named(&press(&find), &sign), ("load-wrong", 1.0));
}

/// A four-bar linkage whose numbers were calculated with one given number misread; position and rates by the loop equation.
fn misread(o4: [f64; 2], [crank, rod, rocker]: [f64; 3], angle: f64) -> Value {
    let omega = -6.0 * std::f64::consts::PI;
    let (sin, cos) = (libm::sin(angle.to_radians()), libm::cos(angle.to_radians()));
    let a = [crank * cos, crank * sin];
    let [x, y] = [o4[0] - a[0], o4[1] - a[1]];
    let far = libm::hypot(x, y);
    let along = (far * far + rod * rod - rocker * rocker) / (2.0 * far);
    let across = libm::sqrt(rod * rod - along * along);
    let [ux, uy] = [x / far, y / far];
    let side = |across: f64| [a[0] + along * ux - across * uy, a[1] + along * uy + across * ux];
    let away = |b: [f64; 2]| libm::hypot(b[0] - 130.0, b[1] - 110.0);
    let b = if away(side(across)) < away(side(-across)) { side(across) } else { side(-across) };
    let [ba, bo] = [[b[0] - a[0], b[1] - a[1]], [b[0] - o4[0], b[1] - o4[1]]];
    // ω₃ × BA − ω₄ × BO = d
    let solved = |d: [f64; 2]| {
        let det = -ba[1] * -bo[0] - bo[1] * ba[0];
        [(d[0] * -bo[0] - bo[1] * d[1]) / det, (-ba[1] * d[1] - ba[0] * d[0]) / det]
    };
    let va = [-omega * a[1], omega * a[0]];
    let [w3, w4] = solved([-va[0], -va[1]]);
    let aa = [-omega * omega * a[0], -omega * omega * a[1]];
    let part = |axis: usize| w3 * w3 * ba[axis] - w4 * w4 * bo[axis] - aa[axis];
    let [e3, e4] = solved([part(0), part(1)]);
    let vb = [-w4 * bo[1], w4 * bo[0]];
    let ab = [-e4 * bo[1] - w4 * w4 * bo[0], e4 * bo[0] - w4 * w4 * bo[1]];
    let rate = |value: f64| turning(value.abs(), if value < 0.0 { "cw" } else { "ccw" });
    json!({
        "v(B)": { "components": vb }, "omega(3)": rate(w3), "omega(4)": rate(w4),
        "a(B)": { "components": ab }, "alpha(3)": rate(e3), "alpha(4)": rate(e4)
    })
}

#[test]
fn a_given_number_that_was_misread_costs_one_mark() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [150, 20] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 45 }, "3": { "joins": ["A", "B"], "length": 130 },
            "4": { "joins": ["O4", "B"], "length": 90 }
        },
        "near": { "B": [130, 110] }, "input": { "link": 2, "angle": 70, "omega": "180 rpm cw" },
        "find": ["v(B)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)"]
    });
    let right = misread([150.0, 20.0], [45.0, 130.0, 90.0], 70.0);
    let report = graded(&scene, &json!({ "values": right }));
    assert!(report.first_fault().is_none(), "{}", report.to_text());
    for (values, kind) in [
        (misread([20.0, 150.0], [45.0, 130.0, 90.0], 70.0), "pivot-misplaced"),
        (misread([150.0, -20.0], [45.0, 130.0, 90.0], 70.0), "pivot-misplaced"),
        (misread([150.0, 20.0], [45.0, 90.0, 130.0], 70.0), "length-laid-off"),
        (misread([150.0, 20.0], [22.5, 130.0, 90.0], 70.0), "length-laid-off"),
        (misread([150.0, 20.0], [54.0, 130.0, 90.0], 70.0), "length-laid-off"),
        (misread([150.0, 20.0], [45.0, 130.0, 90.0], 250.0), "input-angle"),
        (misread([150.0, 20.0], [45.0, 130.0, 90.0], 160.0), "input-angle"),
    ] {
        let report = graded(&scene, &json!({ "values": values }));
        let fault = report.first_fault().unwrap();
        assert_eq!(fault.mistakes.first().map(|first| first.kind.name()), Some(kind), "{}", report.to_text());
        let wrong = report.quantities.iter().filter(|one| one.verdict == Verdict::Wrong).count();
        assert_eq!(wrong, 1, "{}", report.to_text());
    }
}

#[test]
fn a_skeleton_at_another_scale_is_compared_at_its_own() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [150, 20] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 45 }, "3": { "joins": ["A", "B"], "length": 130 },
            "4": { "joins": ["O4", "B"], "length": 90 }
        },
        "near": { "B": [130, 110] }, "input": { "link": 2, "angle": 70, "omega": "180 rpm cw" },
        "find": ["omega(3)"]
    });
    let right = misread([150.0, 20.0], [45.0, 130.0, 90.0], 70.0);
    // B by V_B = ω₄ × BO₄.
    let parts: Vec<f64> =
        right["v(B)"]["components"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let omega = -right["omega(4)"]["value"].as_f64().unwrap();
    let b = [150.0 + parts[1] / omega, 20.0 - parts[0] / omega];
    let a = [45.0 * libm::cos(70.0_f64.to_radians()), 45.0 * libm::sin(70.0_f64.to_radians())];
    let enlarged = [0.5, 2.5].map(|times| {
        let at = |[x, y]: [f64; 2]| json!([x * times, y * times]);
        let skeleton = json!({ "O2": [0, 0], "O4": at([150.0, 20.0]), "A": at(a), "B": at(b) });
        let answers =
            json!({ "values": { "omega(3)": right["omega(3)"] }, "points": { "skeleton": skeleton } });
        let report = graded(&scene, &answers);
        assert!(report.first_fault().is_none(), "{}", report.to_text());
        // Nothing is told of the scale of the sheet itself.
        report.enlarged.unwrap_or(1.0)
    });
    assert!((enlarged[1] / enlarged[0] / 5.0 - 1.0).abs() < 1e-6, "{enlarged:?}");
}

/// A₂′ of a slotted lever is wrong: a₄′ lies beside its right place by as much as that leads to, and not on the other side
/// of it. Numbers by complex kinematics: from (−90, −30) for (−83.4, −25.6) follows 6 mm along the guide's normal.
#[test]
fn the_image_under_a_rider_follows_on_its_own_side() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [30, -140] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "4": { "joins": ["O4", "B"], "length": 240 } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } }],
        "near": { "B": [60, 100] },
        "input": { "link": 2, "angle": 25, "omega": "12 rad/s ccw", "alpha": "20 rad/s^2 ccw" },
        "find": ["v(A)", "v(A@4)", "v(B)", "alpha(4)", "a(B)"]
    });
    let verdict = |far: f64| {
        let under = [-51.1 - 0.98929 * far, -2.0 + 0.14585 * far];
        let answers = json!({
            "points": {
                "velocity": { "o": [0, 0], "a2": [-30.4, 65.3], "a4": [-39.2, 5.8], "b": [-56.3, 8.3] },
                "acceleration": { "o'": [0, 0], "a2'": [-90, -30], "a4'": under }
            },
            "scales": { "velocity": "10 mm/s per mm", "acceleration": "100 mm/s^2 per mm" }
        });
        let report = graded(&scene, &answers);
        let own = report.quantities.iter().find(|one| one.name == "acceleration:a4'").unwrap();
        own.verdict
    };
    assert_eq!(verdict(6.0), Verdict::Consistent);
    assert_eq!(verdict(-6.0), Verdict::Wrong);
}

/// Four numbers that belong to no motion, and a fifth that was scanned over what it might follow from: before, 22 of 42
/// such numbers followed rightly.
#[test]
fn numbers_of_no_motion_lead_to_little() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [150, 20] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 45 }, "3": { "joins": ["A", "B"], "length": 130 },
            "4": { "joins": ["O4", "B"], "length": 90 }
        },
        "near": { "B": [130, 110] }, "input": { "link": 2, "angle": 70, "omega": "180 rpm cw" },
        "find": ["v(B)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)"]
    });
    let follows = |alpha: f64| {
        let values = json!({
            "v(B)": { "components": [-312, -701] }, "omega(3)": turning(9.13, "cw"),
            "omega(4)": turning(2.21, "ccw"), "a(B)": { "components": [5210, -3333] },
            "alpha(4)": turning(alpha, "ccw")
        });
        let report = graded(&scene, &json!({ "values": values }));
        report.quantities.iter().any(|one| one.name == "alpha(4)" && one.verdict == Verdict::Consistent)
    };
    let scanned = (0..14).map(|step| 22.0 * libm::pow(1.08, 3.0 * f64::from(step)));
    let followed = scanned.filter(|alpha| follows(*alpha)).count();
    assert!(followed <= 3, "{followed} of 14");
}

#[test]
fn a_load_in_the_wrong_sense_costs_one_mark() {
    // F₃₄ along the rod, N on the guide, T = F₃₂ times its arm: all of them turned about.
    let (crank, rod) = (80.0_f64, 300.0_f64);
    let sine = crank * libm::sin(std::f64::consts::FRAC_PI_4) / rod;
    let tangent = sine / libm::sqrt(1.0 - sine * sine);
    let along = 2000.0 / libm::sqrt(1.0 - sine * sine);
    let lean = libm::asin(sine).to_degrees();
    // The piston is drawn outward: the rod holds it back along itself, from B toward A.
    let square = 2000.0 * tangent;
    let height = crank * libm::sin(std::f64::consts::FRAC_PI_4);
    let reach = crank * libm::cos(std::f64::consts::FRAC_PI_4);
    // F₃₂ = (2000, −square) at A; T balances its moment.
    let moment = (reach * -square - height * 2000.0) / 1000.0;
    let values = json!({
        "F(3,4)": vector(along, 180.0 - lean), "F(1,4)": vector(square, -90.0),
        "T(2)": turning(moment.abs(), if moment < 0.0 { "ccw" } else { "cw" })
    });
    let names = ["F(3,4)", "F(1,4)", "T(2)"];
    let report = graded(&gas_engine(&names), &json!({ "values": values }));
    assert_eq!(report.sum(), (2.0, 3.0), "{}", report.to_text());
    let fault = report.first_fault().unwrap();
    assert!(fault.mistakes.iter().any(|mistake| mistake.kind.name() == "sense-reversed"), "{fault:?}");
}

#[test]
fn a_step_that_is_not_asked_does_not_pay_for_what_is() {
    // Aⁿ of the rod points from A to B; A_B is drawn from it.
    let end = vector(6107.0, -154.1);
    let scene = crank_and_rocker(&["a(B)"]);
    let alone = graded(&scene, &json!({ "values": { "a(B)": end } }));
    let shown = graded(&scene, &json!({ "values": { "an(B/A)": vector(1423.0, 22.5), "a(B)": end } }));
    assert_eq!((alone.sum(), shown.sum()), ((0.0, 1.0), (0.0, 1.0)), "{}", shown.to_text());
    let named = |report: &Report| report.first_fault().unwrap().mistakes[0].kind;
    assert_eq!(named(&alone), named(&shown));
    assert!(shown.to_text().contains("costs its mark here"), "{}", shown.to_text());
}

/// The kind that is named first for a hand-in, and its marks lost.
fn named(scene: &Value, values: &Value) -> (&'static str, f64) {
    let report = graded(scene, &json!({ "values": values }));
    let kind = report.first_fault().unwrap().mistakes.first().map_or("", |mistake| mistake.kind.name());
    let (reached, of) = report.sum();
    (kind, of - reached)
}

#[test]
fn mistakes_of_a_crank_and_rocker_are_named() {
    let find = ["v(A)", "v(B)", "v(B/A)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)"];
    let scene = crank_and_rocker(&find);
    let handed_in = |omegas: [f64; 2], end: Value, alphas: [(f64, &str); 2]| {
        json!({
            "v(A)": vector(754.0, 150.0), "v(B)": vector(478.7, -174.0), "v(B/A)": vector(462.0, -67.5),
            "omega(3)": turning(omegas[0], "cw"), "omega(4)": turning(omegas[1], "ccw"), "a(B)": end,
            "alpha(3)": turning(alphas[0].0, alphas[0].1), "alpha(4)": turning(alphas[1].0, alphas[1].1)
        })
    };
    // V_B/AB for ω₃, and all that follows.
    let rod = handed_in([3.191, 4.351], vector(9061.0, -160.7), [(41.87, "ccw"), (80.16, "ccw")]);
    assert_eq!(named(&scene, &rod), ("rate-from-wrong-vector", 1.0));
    // ω₄ in degrees per second, and nothing follows.
    let degrees = handed_in([3.08, 249.3], vector(8954.0, -160.6), [(41.67, "ccw"), (79.17, "ccw")]);
    assert_eq!(named(&scene, &degrees), ("deg-as-rad", 1.0));
    // Both normal parts that are found point outward: one cause.
    let outward = handed_in([3.08, 4.351], vector(7282.0, 169.3), [(65.0, "ccw"), (63.44, "ccw")]);
    assert_eq!(named(&scene, &outward), ("normal-away-from-centre", 1.0));
    // The direction counted clockwise.
    let clockwise = handed_in([3.08, 4.351], vector(8954.0, 160.6), [(41.67, "ccw"), (79.17, "ccw")]);
    assert_eq!(named(&scene, &clockwise), ("direction-measured-otherwise", 1.0));
}

#[test]
fn coriolis_with_another_velocity_is_named() {
    let scene = json!({
        "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, -26] },
        "links": { "2": { "joins": ["O2", "A"], "length": 12 }, "4": { "joins": ["O4", "B"], "length": 55 } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } }],
        "near": { "B": [10, 27] }, "input": { "link": 2, "angle": 50, "omega": "5 rad/s ccw" },
        "find": ["omega(4)", "v(A@4)", "slip(A/4)", "coriolis(A/4)", "aslip(A/4)", "alpha(4)"]
    });
    // 2·ω₄·V_A.
    let values = json!({
        "omega(4)": turning(1.475, "ccw"), "v(A@4)": vector(53.15, 167.6), "slip(A/4)": vector(27.83, 77.6),
        "coriolis(A/4)": vector(177.0, 167.6), "aslip(A/4)": vector(187.3, -102.4),
        "alpha(4)": turning(1.051, "cw")
    });
    assert_eq!(named(&scene, &values), ("coriolis-wrong-velocity", 1.0));
}

/// The pole at (100, 100) and the image of A beside it, both with their letters.
fn drawing(more: &str) -> String {
    let mark = |x: f64, name: &str| {
        format!(
            "<circle cx=\"{x}\" cy=\"100\" r=\"0.4\"/><text x=\"{x}\" y=\"98\" font-size=\"3\">{name}</text>"
        )
    };
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"210mm\" height=\"297mm\" viewBox=\"0 0 210 297\">{}{}{more}</svg>",
        mark(100.0, "o"),
        mark(60.0, "a"),
    )
}

#[test]
fn what_a_drawing_hides_is_not_read() {
    let scene = crank_and_rocker(&["v(A)"]).to_string();
    let scene = linkgram::scene::read(&scene, "scene.json").unwrap();
    let names = |more: &str| -> Vec<String> {
        let answers = read_named(&drawing(more), "a.svg", &scene).unwrap();
        let report = grade(&scene, &answers, &GradeSettings::default()).unwrap();
        report.quantities.iter().map(|graded| graded.name.clone()).collect()
    };
    let own = names("");
    let b = "<circle cx=\"20\" cy=\"20\" r=\"0.4\"/><text x=\"21\" y=\"20\" font-size=\"3\">b</text>";
    assert_ne!(names(&format!("<g>{b}</g>")), own);
    for hidden in ["style=\"display:none\"", "display=\"none\"", "style=\"visibility: hidden\""] {
        assert_eq!(names(&format!("<g {hidden}>{b}</g>")), own, "{hidden}");
    }
    let back = format!("<g visibility=\"hidden\"><g visibility=\"visible\">{b}</g></g>");
    assert_ne!(names(&back), own);
}
