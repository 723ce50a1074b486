//! Sweeps in which a link is led far from where the scene has it: the independent solver has to find it there, and not where
//! it stood at the scene's instant. Closed forms of this file tell what is right.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::f64::consts::TAU;

use linkgram::check::{self, confirm_sweep};
use linkgram::mechanism::quantity::{Answer, Indeterminate, Stuck};
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::solve::{solve, solve_analytically};
use linkgram::sweep::{Sweep, SweepError};

fn read(text: &str) -> Scene {
    scene::read(text, "scene.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn swept(text: &str) -> Sweep {
    Sweep::new(&read(text).mechanism, None).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn confirmed(sweep: &Sweep) {
    assert!(confirm_sweep(sweep).is_ok_and(|positions| positions > 4), "{:?}", confirm_sweep(sweep));
}

/// A number of a sweep, SI units.
fn number(sweep: &Sweep, name: &str, at: f64) -> f64 {
    let column = sweep.columns.iter().position(|column| column.name() == name).unwrap();
    sweep.at(at).unwrap()[column].unwrap().value
}

/// A slotted lever that a crank of 60 mm leads once round: O₄ lies 25 mm below O₂. In the crank's angle.
struct Whitworth;

impl Whitworth {
    /// Crank, distance of the pivots, distance of the lever's mass centre.
    const SIZES: [f64; 3] = [0.06, 0.025, 0.07];

    fn scene(mass: &str, more: &str) -> String {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -25] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "4": {{ "joins": ["O4", "B"], "length": 150 }} }},
            "slides": [ {{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": "O4" }} }} ],
            "near": {{ "B": [30, 110] }}, "input": {{ "link": 2, "angle": 80, "omega": "10 rad/s ccw" }},
            "masses": {{ "4": {mass} }}, {more} }}"#
        )
    }

    /// The lever's angle, on and on.
    fn angle(crank: f64) -> f64 {
        let [r, e, _] = Self::SIZES;
        let (sin, cos) = libm::sincos(crank);
        let angle = libm::atan2(r * sin + e, r * cos);
        angle + TAU * libm::round((crank - angle) / TAU)
    }

    /// Its first and second derivative: of r + e sin θ over the square of O₄A, times r.
    fn slopes(crank: f64) -> [f64; 2] {
        let [r, e, _] = Self::SIZES;
        let (sin, cos) = libm::sincos(crank);
        let square = r * r + e * e + 2.0 * r * e * sin;
        let above = r * (r + e * sin);
        let first = above / square;
        [first, (r * e * cos * square - above * 2.0 * r * e * cos) / (square * square)]
    }
}

/// The lever's mass centre is a point by own coordinates; its named end B, which nobody asks for, stood elsewhere at the
/// scene's instant. The shaking force is −m a_G.
#[test]
fn a_lever_that_turns_round_is_found_where_it_stands() {
    let masses = [r#"{ "mass": 1, "at": [70, 0] }"#, r#"{ "mass": 1, "at": [70, 0], "inertia": 0.004 }"#];
    for mass in masses {
        let sweep = swept(&Whitworth::scene(mass, r#""find": ["T(2)", "F(1,4)", "FS"]"#));
        confirmed(&sweep);
        for step in 0..24 {
            let at = TAU * f64::from(step) / 24.0 + 0.01;
            let [first, second] = Whitworth::slopes(at).map(|slope| slope * 100.0);
            let omega_squared = first * first / 100.0;
            let (sin, cos) = libm::sincos(Whitworth::angle(at));
            let arm = Whitworth::SIZES[2];
            let along = [-omega_squared * cos - second * sin, -omega_squared * sin + second * cos];
            for (name, acceleration) in ["FS.x", "FS.y"].into_iter().zip(along) {
                let found = number(&sweep, name, at);
                let wanted = -arm * acceleration;
                assert!((found - wanted).abs() < 1e-9 * 100.0, "{name} at {at}: {found}, not {wanted}");
            }
        }
    }
}

/// The same lever against a torque of 20 N·m under gravity, over one turn: what the crank gives is the change of the lever's
/// energy and 20 N·m times what the lever has turned.
#[test]
fn the_work_of_a_lever_that_turns_round_is_told() {
    let more = r#""loads": [ { "on": 4, "torque": "20 N*m", "direction": "against" } ], "gravity": {},
        "cycle": { "load": { "of": 2 } }, "find": ["Tmean", "Ef", "crossing(1)", "crossing(2)"]"#;
    let scene = read(&Whitworth::scene(r#"{ "mass": 1, "at": [70, 5], "inertia": 0.004 }"#, more));
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{:?} {:?}", agreement.refused, agreement.disagreements());
    let found: Vec<f64> = agreement
        .compared
        .iter()
        .map(|compared| match (&compared.graphical.answer, &compared.analytic) {
            (Answer::Scalar { value, .. }, Answer::Scalar { .. }) => *value,
            other => panic!("{}: {other:?}", compared.asked.name),
        })
        .collect();
    // G lies 5 mm to the left of the lever's own line.
    let (arm, beside) = (0.07, 0.005);
    let inertia = 0.004 + arm * arm + beside * beside;
    let level = |crank: f64| {
        let angle = Whitworth::angle(crank);
        let (sin, cos) = libm::sincos(angle);
        let omega = 10.0 * Whitworth::slopes(crank)[0];
        let energy = 9.80665 * (arm * sin + beside * cos) + 0.5 * inertia * omega * omega;
        20.0 * crank - energy - 20.0 * angle
    };
    let net = |crank: f64| (level(crank + 1e-5) - level(crank - 1e-5)) / 2e-5;
    let mut crossings = Vec::new();
    let looks = 3600;
    for look in 0..looks {
        let [mut low, mut high] = [look, look + 1].map(|look| TAU * f64::from(look) / f64::from(looks));
        if net(low) * net(high) < 0.0 {
            for _ in 0..60 {
                let middle = f64::midpoint(low, high);
                if net(low) * net(middle) <= 0.0 { high = middle } else { low = middle }
            }
            crossings.push(low);
        }
    }
    assert_eq!(crossings.len(), 2);
    let fluctuation = (level(crossings[0]) - level(crossings[1])).abs();
    assert!((found[0] - 20.0).abs() < 1e-7, "{found:?}");
    assert!((found[1] - fluctuation).abs() < 1e-4 * fluctuation, "{found:?}, not {fluctuation}");
    for (found, wanted) in found[2..].iter().zip(&crossings) {
        assert!((found - wanted).abs() < 1e-4, "{found} is not {wanted}");
    }
}

/// Davis' steering: the cross rod leads a pin along the guide of each lever, and where that guide points the lever's end is
/// the only one to tell. The angle of a lever is that of O₂A less 108°.
#[test]
fn a_steering_lever_keeps_its_side() {
    let davis = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == "davis").unwrap();
    let mut root: serde_json::Value = serde_json::from_str(davis.scene).unwrap();
    root["find"] = serde_json::json!(["angle(2)", "omega(2)"]);
    let sweep = swept(&root.to_string());
    confirmed(&sweep);
    let mut compared = 0;
    for at in sweep.equal_steps(40) {
        let Some(found) = sweep.at(at).and_then(|values| values[0]) else { continue };
        // A lies 135 mm to the left of C, which is 200 mm beside O2, and all of it 100 mm below.
        let angle = libm::atan2(-0.1, 0.2 - 0.135 + at) - 108.0_f64.to_radians();
        let apart = found.value - angle;
        let apart = apart - TAU * libm::round(apart / TAU);
        assert!(apart.abs() < 1e-9, "{at}: {}, not {angle}", found.value);
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

/// A rod that rides on a crank's guide and through a swivelling one, which it turns with it: when its joint has passed that of
/// the swivel, the swivel still turns on, and points away from it. The crank's guide stands square to the other.
#[test]
fn a_swivel_turns_on_when_its_rider_has_passed() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "A": [0, 0], "G": [60, 10] },
        "links": { "3": { "joins": ["A", "B"], "length": 50 }, "7": { "joins": ["H", "I"], "length": 30 },
                   "6": { "joins": ["G"] } },
        "slides": [ { "link": 7, "turned": 0, "on": { "link": 3, "through": [40, 0], "angle": 60 } },
                    { "link": 7, "turned": -90, "on": { "link": 6, "through": "G" } } ],
        "near": { "H": [37.6, 13.9], "I": [42.8, 43.5] },
        "input": { "link": 3, "angle": 20, "omega": "2 rad/s ccw" }, "find": ["x(H)", "angle(6)", "v(I)"] }"#;
    let sweep = swept(text);
    confirmed(&sweep);
    let mut sides = [0, 0];
    for at in sweep.equal_steps(72) {
        let along = at + 60.0_f64.to_radians();
        let (sin, cos) = libm::sincos(along);
        let (sin_of_crank, cos_of_crank) = libm::sincos(at);
        let from_guide = [0.06 - 0.04 * cos_of_crank, 0.01 - 0.04 * sin_of_crank];
        // As far as G lies to the right of the crank's guide, H lies before it.
        let way = -(cos * from_guide[1] - sin * from_guide[0]);
        sides[usize::from(way > 0.0)] += 1;
        for (name, wanted) in [("x(H).x", 0.06 - way * sin), ("x(H).y", 0.01 + way * cos)] {
            let found = number(&sweep, name, at);
            assert!((found - wanted).abs() < 1e-13, "{name} at {at}: {found}, not {wanted}");
        }
        let apart = number(&sweep, "angle(6)", at) - (along + TAU / 4.0);
        assert!((apart - TAU * libm::round(apart / TAU)).abs() < 1e-12, "at {at}: {apart}");
    }
    assert!(sides.iter().all(|side| *side > 10), "{sides:?}");
}

/// Close to a limit two balances with friction fit, and no force is told there; elsewhere it is, and both solvers have one.
/// The rod pushes or pulls along the line that touches both its friction circles, on opposite sides. Where that passes
/// the rocker's pivot by less than its circle, it turns the rocker in the same sense either way: at A, B and O₄ circles of
/// ρ, rod 50 mm, rocker 80 mm.
#[test]
fn beside_a_limit_friction_leaves_several_balances_and_no_force() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 50 },
                   "4": { "joins": ["O4", "B"], "length": 80 } },
        "near": { "B": [60, 70] }, "input": { "link": 2, "angle": 40, "omega": "10 rad/s ccw" },
        "pins": { "O2": { "radius": 15, "f": 0.15 }, "A": { "radius": 15, "f": 0.15 }, "B": { "radius": 15, "f": 0.15 },
                  "O4": { "radius": 15, "f": 0.15 } },
        "loads": [ { "on": 4, "torque": "20 N*m ccw" } ], "find": ["T(2)", "F(3,4)", "omega(4)"] }"#;
    let sweep = swept(text);
    confirmed(&sweep);
    let [[from, to]] = sweep.ambiguous[..] else { panic!("{:?}", sweep.ambiguous) };
    assert!(sweep.stretches.iter().any(|stretch| stretch.to == to), "{to}");
    let stuck_at = |at: f64| {
        let mechanism = sweep.marked_at(at).unwrap();
        let torque = mechanism.asked[0].quantity;
        match linkgram::analytic::solve_for(&mechanism, &[torque]).unwrap().answer(&torque) {
            Answer::Indeterminate(Indeterminate::Rubbing { how, .. }) => Some(how),
            _ => None,
        }
    };
    for part in [0.1, 0.5, 0.9] {
        let at = from + part * (to - from);
        let values = sweep.at(at).unwrap();
        assert!(values[..3].iter().all(Option::is_none), "{values:?}");
        assert!(values[3].is_some(), "what moves is known");
        assert_eq!(stuck_at(at), Some(Stuck::Ambiguous));
    }
    let mut told = 0;
    for at in sweep.equal_steps(72).into_iter().filter(|at| !sweep.is_ambiguous(*at)) {
        let Some(values) = sweep.at(at) else { continue };
        // Where a pair turns round no force is told either.
        if values[..3].iter().any(Option::is_none) {
            continue;
        }
        assert_eq!(stuck_at(at), None, "{at}");
        told += 1;
    }
    assert!(told > 30, "{told}");
    // How far the rod's axis passes O4 where one balance is left, over how far its line may be shifted.
    let circle = 15.0 * libm::sin(libm::atan(0.15));
    let square = 60.0 * 60.0 + 100.0 * 100.0 - 12000.0 * libm::cos(from);
    let cos = (square - 50.0 * 50.0 - 80.0 * 80.0) / 8000.0;
    let axis = 80.0 * (1.0 - cos * cos).sqrt();
    let shifted = circle + 2.0 * circle / 50.0 * 80.0 * cos + circle;
    assert!((1.0 - 1e-3..1.1).contains(&(axis / shifted)), "{axis} {shifted}");
}

/// What does not stand at the scene's own place is refused by a sweep as it is by a solution: nothing is run from there.
#[test]
fn what_does_not_stand_is_not_swept() {
    // Both guides of the yoke are level: no place of its block is on both.
    let text = r#"{ "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "4": { "joins": ["C"] } },
        "slides": [ { "link": 4, "on": { "link": 1, "through": [0, -30], "angle": 0 } },
                    { "pin": "A", "block": 3, "on": { "link": 4, "through": "C", "angle": 0 } } ],
        "input": { "link": 2, "angle": 40, "omega": "10 rad/s ccw" }, "find": ["v(C)"] }"#;
    let scene = read(text);
    assert!(solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).is_err());
    assert!(matches!(Sweep::new(&scene.mechanism, None), Err(SweepError::Draw(_))));
}

/// A dyad at the very end of its reach, behind another one at its own: it misses by a rounding, and takes nothing with it
/// that does not hang on it.
#[test]
fn a_dyad_out_of_reach_by_a_rounding_takes_nothing_else_with_it() {
    let text = r#"{ "units": { "length": "cm" }, "fixed": { "O2": [0, 0], "O4": [0, 15] },
        "links": { "2": { "joins": ["O2", "A"], "length": 15 }, "3": { "joins": ["A", "B"], "length": 45 },
                   "4": { "joins": ["O4", "B", "C"], "line": [0, 30, -30] }, "5": { "joins": ["C", "D"], "length": 37 } },
        "slides": [ { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 37], "angle": 0 } } ],
        "near": { "B": [52, -14], "D": [1, 37] }, "input": { "link": 2, "angle": 30, "omega": "10 rad/s cw" },
        "find": ["v(A)", "v(B)", "v(D)"] }"#;
    let scene = read(text);
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{:?} {:?}", agreement.refused, agreement.disagreements());
    // O2A = 15 cm at 10 rad/s.
    for answer in [&agreement.compared[0].graphical.answer, &agreement.compared[0].analytic] {
        let Answer::Vector { value: [x, y], .. } = answer else { panic!("{answer:?}") };
        assert!((libm::hypot(*x, *y) - 1.5).abs() < 1e-12, "{answer:?}");
    }
    for behind in &agreement.compared[1..] {
        assert!(behind.indeterminate().is_some(), "{behind:?}");
    }
}

/// A rough place far off, on the side of the line on which the wheel cannot roll, chooses among what can be assembled.
#[test]
fn a_wheel_is_found_from_afar() {
    for near in ["[440.66, -341.42]", "[100000, 40]"] {
        let text = format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [150, 80] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 120 }}, "3": {{ "joins": ["O4", "C"], "length": 70 }},
                       "4": {{ "joins": ["C"] }} }},
            "rolls": [ {{ "links": [2, 4], "line": {{ "link": 2, "through": "O2", "angle": 0 }}, "centre": "C", "radius": 25 }} ],
            "near": {{ "C": {near} }}, "input": {{ "link": 2, "angle": 10, "omega": "3 rad/s ccw" }},
            "find": ["x(C)", "v(C)", "omega(4)"] }}"#
        );
        let scene = read(&text);
        let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
        let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(agreement.ok(), "{near}: {:?} {:?}", agreement.refused, agreement.disagreements());
        // 25 mm beside the line at 10 deg, and 70 mm from O4: of two such places the nearer one.
        let (sin, cos) = libm::sincos(10.0_f64.to_radians());
        let across = 25.0;
        let [along, off] = [150.0 * cos + 80.0 * sin, -150.0 * sin + 80.0 * cos];
        let reach = (70.0_f64 * 70.0 - (off - across) * (off - across)).sqrt();
        let wanted = [along + reach, across];
        let wanted = [wanted[0] * cos - wanted[1] * sin, wanted[0] * sin + wanted[1] * cos];
        let Answer::Vector { value, .. } = agreement.compared[0].analytic else { panic!() };
        let missed = libm::hypot(value[0] - wanted[0] * 1e-3, value[1] - wanted[1] * 1e-3);
        assert!(missed < 1e-12, "{near}: {value:?}, not {wanted:?}");
    }
}
