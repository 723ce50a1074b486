//! Friction: closed forms, a balance of four bars written down by hand, laws, what locks, and random chains by both
//! solvers.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeMap;

use linkgram::check::{self, Agreement};
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Refusal, Scene};
use linkgram::solve::solve;

use crate::common;
use crate::forces::Chain;

fn read(text: &str) -> Scene {
    scene::read(text, "friction.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refusal(text: &str) -> String {
    scene::read(text, "friction.json").unwrap_err().to_string()
}

fn agreed(scene: &Scene) -> Agreement {
    let solved = solve(scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    check::agreement(scene, &solved, &linkgram::solve::solve_analytically(scene))
}

/// Answers by name, both solvers and the powers in agreement.
fn answers(scene: &Scene) -> BTreeMap<String, Vec<f64>> {
    let agreement = agreed(scene);
    assert!(agreement.ok(), "{:?} {:?}", agreement.refused, agreement.disagreements());
    let power = agreement.power.unwrap();
    assert!(power.friction <= 0.0 && power.bound.is_finite(), "{power:?}");
    let told = agreement.compared.iter().map(|compared| {
        let number = match &compared.graphical.answer {
            Answer::Scalar { value, .. } => vec![*value],
            Answer::Vector { value, .. } => value.to_vec(),
            other => panic!("{}: {other:?}", compared.asked.name),
        };
        (compared.asked.name.clone(), number)
    });
    told.collect()
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

const LINKS: &str = r#""units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
  "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 } },
  "near": { "B": [240, 0] }"#;

/// A slider-crank with friction everywhere, at 50°, turning ccw (`turn` 1) or cw (−1).
fn crank(turn: f64, load: &str, pins: &str, slide: &str, find: &str) -> String {
    format!(
        r#"{{ {LINKS}, "input": {{ "link": 2, "angle": 50, "omega": {} }},
        "slides": [ {{ "pin": "B", "block": 4, {slide} "on": {{ "link": 1, "through": "O2" }} }} ],
        "pins": {{ {pins} }}, "loads": [ {load} ], "find": [ {find} ] }}"#,
        10.0 * turn
    )
}

const PINS: &str = r#""O2": { "radius": 20, "f": 0.08 }, "A": { "diameter": 36, "f": 0.08 }, "B": { "radius": 12, "f": 0.08 }"#;

/// The torque of the slider-crank whose piston a force of `load` (to the right) loads while it moves to the left, with
/// friction circles of these radii and this coefficient at the guide: the rod's force runs along a tangent of both its
/// circles, the guide's leans, and the crank feels the three circles and its arm. `inner` is −1 for the other tangent.
fn by_tangents(load: f64, [at_o, at_a, at_b]: [f64; 3], f: f64, inner: f64) -> f64 {
    let (r, l) = (0.06, 0.22);
    let theta = 50.0_f64.to_radians();
    let rod = -libm::asin(r * libm::sin(theta) / l);
    let line = rod - inner * libm::asin((at_a + at_b) / l);
    let pull = load / (libm::cos(line) - f * libm::sin(line).abs());
    pull * (r * libm::sin(theta - line) + at_a + at_o)
}

#[test]
fn a_slider_crank_is_its_closed_form() {
    let phi = libm::atan(0.08);
    let circles = [20e-3, 18e-3, 12e-3].map(|r| r * libm::sin(phi));
    let load = r#"{ "on": 4, "force": 1500, "direction": "against" }"#;
    let scene =
        crank(1.0, load, PINS, r#""f": 0.1,"#, r#""T(2)", "arm(F(3,4),B)", "arm(F(1,2),O2)", "F(1,4)""#);
    let found = answers(&read(&scene));
    let torque = by_tangents(1500.0, circles, 0.1, 1.0);
    near(found["T(2)"][0], torque);
    near(found["arm(F(3,4),B)"][0], circles[2]);
    near(found["arm(F(1,2),O2)"][0], circles[0]);
    // The guide's force leans by the angle of friction, against the sliding to the left.
    near(found["F(1,4)"][0] / found["F(1,4)"][1].abs(), 0.1);
    // The other tangent, and a lean to the other side, are other numbers.
    assert!((torque - by_tangents(1500.0, circles, 0.1, -1.0)).abs() > 0.1);
    assert!((torque - by_tangents(1500.0, circles, -0.1, 1.0)).abs() > 0.1);
    // A friction circle that is given, and an angle in the place of a coefficient, say the same.
    let pins = format!(
        r#""O2": {{ "circle": {} }}, "A": {{ "radius": 18, "f": "{} rad" }}, "B": {{ "radius": 12, "f": "0.08" }}"#,
        circles[0] * 1e3,
        phi
    );
    let slide = format!(r#""f": "{} deg","#, libm::atan(0.1_f64).to_degrees());
    let same = answers(&read(&crank(1.0, load, &pins, &slide, r#""T(2)""#)));
    near(same["T(2)"][0], torque);
}

/// A constant force turns round with the motion, whatever presses on the guide.
#[test]
fn a_drag_is_a_load_against_the_sliding() {
    let with = |slide: &str, load: &str| {
        let scene = crank(1.0, load, "", slide, r#""T(2)", "F(1,4)""#);
        answers(&read(&scene))
    };
    let both = with(r#""drag": 100,"#, r#"{ "on": 4, "force": 1500, "direction": 0 }"#);
    let one = linkgram::solve::solve(
        &read(&crank(1.0, r#"{ "on": 4, "force": 1600, "direction": 0 }"#, "", "", r#""T(2)""#)),
        Extent::Asked,
        linkgram::sheet::scale::for_scene,
    );
    let Answer::Scalar { value, .. } = one.unwrap().solution.construction.answers[0].answer else { panic!() };
    near(both["T(2)"][0], value);
    near(both["F(1,4)"][0], 100.0);
    let rough = with(r#""drag": 100, "f": 0.2,"#, r#"{ "on": 4, "force": 1500, "direction": 0 }"#);
    near(rough["F(1,4)"][0] - 100.0, 0.2 * rough["F(1,4)"][1].abs());
}

/// W (sin α ± f cos α) up and down an incline, with the angle of friction as well.
#[test]
fn a_block_on_an_incline() {
    let incline = |velocity: f64, f: &str| {
        let scene = format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, "placed": {{ "B": [{}, {}] }}, "links": {{ "2": {{ "joins": ["B"] }} }},
            "slides": [ {{ "pin": "B", "block": 2, "f": {f}, "on": {{ "link": 1, "through": "O", "angle": 20 }} }} ],
            "input": {{ "slide": 2, "velocity": {velocity} }}, "gravity": {{}},
            "masses": {{ "2": {{ "weight": 80 }} }}, "find": [ "drive(B)", "F(1,2)" ] }}"#,
            3.0 * libm::cos(20.0_f64.to_radians()),
            3.0 * libm::sin(20.0_f64.to_radians()),
        );
        answers(&read(&scene))["drive(B)"][0]
    };
    let (sin, cos) = libm::sincos(20.0_f64.to_radians());
    near(incline(1.0, "0.3"), 80.0 * (sin + 0.3 * cos));
    near(incline(-2.0, "0.3"), 80.0 * (sin - 0.3 * cos));
    near(incline(5.0, "\"15 deg\""), 80.0 * (sin + libm::tan(15.0_f64.to_radians()) * cos));
}

/// A weight on an arm, lifted and let down: W (x ± r sin φ).
#[test]
fn a_journal_under_a_weight() {
    let torque = |omega: f64| {
        let scene = format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, "links": {{ "2": {{ "joins": ["O", "A"], "length": 2 }} }},
            "input": {{ "link": 2, "angle": 30, "omega": {omega} }}, "pins": {{ "O": {{ "radius": 0.1, "f": 0.2 }} }},
            "loads": [ {{ "on": 2, "at": "A", "force": 50, "direction": -90 }} ], "find": [ "T(2)", "arm(F(1,2),O)" ] }}"#
        );
        answers(&read(&scene))["T(2)"][0]
    };
    let circle = 0.1 * 0.2 / libm::sqrt(1.0 + 0.04);
    near(torque(1.0), 50.0 * (2.0 * libm::cos(30.0_f64.to_radians()) + circle));
    near(torque(-3.0), 50.0 * (2.0 * libm::cos(30.0_f64.to_radians()) - circle));
}

/// Solves a small system by elimination with the largest pivots.
fn eliminate(mut rows: Vec<Vec<f64>>) -> Vec<f64> {
    let n = rows.len();
    for column in 0..n {
        let pivot = (column..n).max_by(|a, b| rows[*a][column].abs().total_cmp(&rows[*b][column].abs()));
        rows.swap(column, pivot.unwrap());
        for row in 0..n {
            if row != column {
                let factor = rows[row][column] / rows[column][column];
                let above = rows[column].clone();
                for (x, y) in rows[row].iter_mut().zip(&above) {
                    *x -= factor * y;
                }
            }
        }
    }
    (0..n).map(|i| rows[i][n] / rows[i][i]).collect()
}

/// Four bars with circles at all four pins: Newton and Euler for each link, with the couples of the forces found before.
#[test]
fn four_bars_are_what_newton_and_euler_say() {
    let places = [[0.0, 0.0], [0.5, 1.0], [3.5, 2.5], [3.0, 0.0]];
    let circles = [0.05, 0.04, 0.03, 0.06];
    let scene = format!(
        r#"{{ "fixed": {{ "O2": [0, 0], "O4": [3, 0] }}, "placed": {{ "A": [0.5, 1], "B": [3.5, 2.5] }},
        "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"] }}, "4": {{ "joins": ["O4", "B"] }} }},
        "input": {{ "link": 2, "omega": 4 }},
        "pins": {{ "O2": {{ "circle": {} }}, "A": {{ "circle": {} }}, "B": {{ "circle": {} }}, "O4": {{ "circle": {} }} }},
        "loads": [ {{ "on": 4, "at": "B", "force": [-20, 7] }}, {{ "on": 3, "at": "A", "force": [3, -30] }},
            {{ "on": 3, "torque": 4 }} ],
        "find": [ "T(2)", "F(1,2)", "F(2,3)", "F(3,4)", "F(1,4)", "omega(3)", "omega(4)", "moment(F(2,3),A)" ] }}"#,
        circles[0], circles[1], circles[2], circles[3]
    );
    let found = answers(&read(&scene));
    let omegas = [0.0, 4.0, found["omega(3)"][0], found["omega(4)"][0]];
    // Unknown: forces of 1 on 2 at O2, of 2 on 3 at A, of 3 on 4 at B, of 1 on 4 at O4, and the torque.
    let pairs = [(0, 1, 0), (1, 2, 1), (2, 3, 2), (0, 3, 3)];
    let mut x = vec![0.0; 9];
    for _ in 0..200 {
        let couple = |pair: usize| {
            let (by, on, _) = pairs[pair];
            -circles[pair] * libm::hypot(x[2 * pair], x[2 * pair + 1]) * (omegas[on] - omegas[by]).signum()
        };
        let couples: Vec<f64> = (0..4).map(couple).collect();
        let mut rows = vec![vec![0.0; 10]; 9];
        for (pair, (by, on, place)) in pairs.into_iter().enumerate() {
            for (body, sign) in [(by, -1.0), (on, 1.0)] {
                if body == 0 {
                    continue;
                }
                let row = 3 * (body - 1);
                let [px, py] = places[place];
                rows[row][2 * pair] += sign;
                rows[row + 1][2 * pair + 1] += sign;
                rows[row + 2][2 * pair] -= sign * py;
                rows[row + 2][2 * pair + 1] += sign * px;
                rows[row + 2][9] -= sign * couples[pair];
            }
        }
        rows[2][8] = 1.0;
        for (body, [px, py], [fx, fy]) in [(3, places[2], [-20.0, 7.0]), (2, places[1], [3.0, -30.0])] {
            let row = 3 * (body - 1);
            rows[row][9] -= fx;
            rows[row + 1][9] -= fy;
            rows[row + 2][9] -= px * fy - py * fx;
        }
        rows[5][9] -= 4.0;
        x = eliminate(rows);
    }
    near(found["T(2)"][0], x[8]);
    for (pair, name) in ["F(1,2)", "F(2,3)", "F(3,4)", "F(1,4)"].into_iter().enumerate() {
        near(found[name][0], x[2 * pair]);
        near(found[name][1], x[2 * pair + 1]);
    }
    let pull = libm::hypot(x[2], x[3]);
    near(found["moment(F(2,3),A)"][0], -circles[1] * pull * (omegas[2] - omegas[1]).signum());
}

/// Torques do not add up; twice the load has twice the torque; the way back takes less.
#[test]
fn superposition_fails_and_proportion_holds() {
    let torque = |turn: f64, along: f64, across: f64| {
        let load = format!(
            r#"{{ "on": 4, "force": [{along}, 0] }}, {{ "on": 3, "at": "A", "force": [0, {across}] }}"#
        );
        answers(&read(&crank(turn, &load, PINS, r#""f": 0.1,"#, r#""T(2)""#)))["T(2)"][0]
    };
    let (first, second, both) =
        (torque(1.0, 1500.0, 0.0), torque(1.0, 0.0, 400.0), torque(1.0, 1500.0, 400.0));
    assert!((both - first - second).abs() > 0.01 * both.abs(), "{both} is {first} + {second}");
    near(torque(1.0, 3000.0, 800.0), 2.0 * both);
    assert!(torque(1.0, 1500.0, 0.0) > torque(-1.0, 1500.0, 0.0) * 1.1);
    let told = refusal(&crank(1.0, r#"{ "on": 4, "force": 1 }"#, PINS, "", r#""T(2).static""#));
    assert!(told.contains("do not add up"), "{told}");
}

/// The whole scene turned: forces turn with it, the torque stays.
#[test]
fn a_turned_scene_has_turned_forces() {
    let turned = |angle: f64| {
        let (sin, cos) = libm::sincos(angle.to_radians());
        let at = |x: f64, y: f64| format!("[{}, {}]", cos * x - sin * y, sin * x + cos * y);
        let scene = format!(
            r#"{{ "fixed": {{ "O2": {}, "O4": {} }}, "placed": {{ "A": {}, "B": {} }},
            "links": {{ "2": {{ "joins": ["O2", "A"] }}, "4": {{ "joins": ["O4", "B"] }} }},
            "slides": [ {{ "pin": "A", "block": 3, "f": 0.2, "on": {{ "link": 4, "through": "O4", "toward": "B" }} }} ],
            "input": {{ "link": 2, "omega": 4 }}, "pins": {{ "A": {{ "radius": 0.1, "f": 0.1 }}, "O4": {{ "circle": 0.02 }} }},
            "loads": [ {{ "on": 4, "at": "B", "force": 20, "direction": {} }} ],
            "find": [ "T(2)", "F(3,4)", "moment(F(3,4),A)", "F(2,3)" ] }}"#,
            at(0.0, 0.0),
            at(0.0, -2.0),
            at(0.8, 0.6),
            at(1.2, 1.9),
            angle + 170.0
        );
        answers(&read(&scene))
    };
    let (still, other) = (turned(0.0), turned(37.0));
    near(other["T(2)"][0], still["T(2)"][0]);
    near(other["moment(F(3,4),A)"][0], still["moment(F(3,4),A)"][0]);
    let (sin, cos) = libm::sincos(37.0_f64.to_radians());
    let [x, y] = [still["F(3,4)"][0], still["F(3,4)"][1]];
    near(other["F(3,4)"][0], cos * x - sin * y);
    near(other["F(3,4)"][1], sin * x + cos * y);
}

/// A steep rod: beyond cot β the guide holds the slider, whatever pushes. With the load turned round two balances fit.
#[test]
fn a_steep_rod_locks() {
    let steep = |f: f64, load: f64, expect: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 70 }} }},
            "slides": [ {{ "pin": "B", "block": 4, "f": {f}, "on": {{ "link": 1, "through": "O2" }} }} ],
            "near": {{ "B": [30, 0] }}, "input": {{ "link": 2, "angle": 80, "omega": -1 }},
            "loads": [ {{ "on": 4, "force": [{load}, 0] }} ], "find": [ "T(2)" ] {expect} }}"#
        )
    };
    let beta = libm::asin(60.0 * libm::sin(80.0_f64.to_radians()) / 70.0);
    let cot = 1.0 / libm::tan(beta);
    let pull = |f: f64| {
        let found = answers(&read(&steep(f, -100.0, "")));
        found["T(2)"][0]
    };
    // The piston is pushed to the right against the load: S (cos β − f sin β) = P.
    let s = 100.0 / (libm::cos(beta) - 0.9 * cot * libm::sin(beta));
    near(pull(0.9 * cot), -s * 0.06 * libm::sin(80.0_f64.to_radians() + beta));
    let told = solve(&read(&steep(1.1 * cot, -100.0, "")), Extent::Asked, linkgram::sheet::scale::for_scene);
    let error = told.unwrap_err();
    assert_eq!(error.refusal(), Some(Refusal::Locked), "{error}");
    let angle = format!("friction angle {:.3}", libm::atan(cot).to_degrees());
    assert!(error.to_string().contains(&angle[..angle.len() - 1]), "{error}: {angle}");
    assert!(error.to_string().contains("slide of B"), "{error}");
    let checked = check::check(&read(&steep(1.1 * cot, -100.0, r#", "expect": "locked""#)), 0.05);
    assert!(checked.ok, "{:?}", checked.outcome);
    let checked = check::check(&read(&steep(1.1 * cot, 100.0, r#", "expect": "ambiguous""#)), 0.05);
    assert!(checked.ok, "{:?}", checked.outcome);
    let below = answers(&read(&steep(0.9 * cot, 100.0, "")));
    let s = 100.0 / (libm::cos(beta) + 0.9 * cot * libm::sin(beta));
    near(below["T(2)"][0], s * 0.06 * libm::sin(80.0_f64.to_radians() + beta));
}

/// Over a turn both solvers agree, the torque leaps where the piston turns round, and without friction it is the known one.
#[test]
fn a_sweep_has_both_sides_of_a_reversal() {
    let load = r#"{ "on": 4, "force": 1500, "direction": "against" }"#;
    let scene = read(&crank(1.0, load, PINS, r#""f": 0.1,"#, r#""T(2)", "v(B)""#));
    let sweep = linkgram::sweep::Sweep::new(&scene.mechanism, None).unwrap();
    assert!(check::confirm_sweep(&sweep).unwrap() > 2);
    let mut seen = 0;
    for position in sweep.positions(&sweep.equal_steps(24)) {
        let Some(torque) = position.values[0] else { continue };
        let mechanism = sweep.mechanism_at(position.at).unwrap();
        let quantities: Vec<_> = mechanism.asked.iter().map(|asked| asked.quantity).collect();
        let state = linkgram::analytic::solve_for(&mechanism, &quantities).unwrap();
        if let Answer::Scalar { value, .. } = state.answer(&quantities[0]) {
            assert!(
                (torque - value).abs() <= 1e-9 * value.abs().max(1.0),
                "at {}: {torque}, {value}",
                position.at
            );
            seen += 1;
        }
    }
    assert!(seen > 18, "{seen}");
}

/// At a dead position the friction of the block turns round, and the force in the rod is greatest just on the side on which
/// friction is against the load: P + f W, by S = (P ± f W)/(cos φ ∓ f sin φ), which falls from there.
#[test]
fn a_leap_is_extreme_on_its_higher_side() {
    use linkgram::sweep::EventKind;
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 100 }, "3": { "joins": ["A", "B"], "length": 300 } },
        "slides": [{ "pin": "B", "block": 4, "f": 0.3, "on": { "link": 1, "through": "O", "angle": 0 } }],
        "near": { "B": [350, 0] }, "input": { "link": 2, "angle": 50, "omega": "10 rad/s ccw" },
        "loads": [{ "name": "P", "on": 4, "at": "B", "force": 1000, "direction": 180 },
                  { "name": "W", "on": 4, "at": "B", "force": 400, "direction": -90 }],
        "find": ["F(3,4)", "T(2)"] }"#;
    let sweep = linkgram::sweep::Sweep::new(&read(text).mechanism, None).unwrap();
    // Where the block stands no torque is needed, whichever way friction acts: T ω = S v. It does not leap, and is not extreme.
    let torque = sweep.columns.iter().position(|column| column.asked.name == "T(2)").unwrap();
    assert_eq!(sweep.reversals.len(), 2);
    for reversal in &sweep.reversals {
        assert!(reversal.leaps(0, true) && !reversal.leaps(torque, false), "{reversal:?}");
    }
    for dead in [0.0, std::f64::consts::PI] {
        let there: Vec<_> = sweep
            .events
            .iter()
            .filter(|event| {
                [0.0, std::f64::consts::TAU].iter().any(|turn| (event.at - dead - turn).abs() < 1e-5)
            })
            .filter(|event| match event.kind {
                EventKind::Least { column, .. } | EventKind::Greatest { column, .. } => {
                    column == 0 || column == torque
                }
                _ => false,
            })
            .collect();
        let [EventKind::Greatest { value, .. }] =
            there.iter().map(|event| event.kind).collect::<Vec<_>>()[..]
        else {
            panic!("at {dead}: {there:?}")
        };
        near(value, 1000.0 + 0.3 * 400.0);
    }
    assert!(check::confirm_sweep(&sweep).unwrap() > 2);
}

/// A sheet with friction is drawn, its numbers confirmed, with the circles, the lean and what is told of them.
#[test]
fn a_sheet_shows_the_circles() {
    let scene = common::example("forces/friction-slider-crank");
    let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default());
    assert!(drawn.is_ok(), "{}", drawn.err().unwrap().told(&scene));
    let solved = solve(&scene, Extent::WholeSkeleton, linkgram::sheet::scale::for_scene).unwrap();
    let sheet = solved.solution.construction.forces.unwrap();
    assert_eq!(sheet.rubs.len(), 4);
    assert!((2..=8).contains(&sheet.passes), "{}", sheet.passes);
    let link = linkgram::mechanism::force::Party::Link(scene.mechanism.link_numbered(3).unwrap());
    let rod = sheet.bodies.iter().find(|body| body.of == link).unwrap();
    assert_eq!(sheet.friction_axis(rod), Some(linkgram::graphical::construction::FrictionAxis::Inner));
}

/// What does not move has no sense of friction; what says too little or too much is an error.
#[test]
fn what_friction_is_refused() {
    let dead = crank(1.0, r#"{ "on": 4, "force": 100 }"#, "", r#""f": 0.1,"#, r#""T(2)""#)
        .replace("\"angle\": 50", "\"angle\": 0")
        .replace("\"find\"", "\"expect\": \"indeterminate\", \"find\"");
    let checked = check::check(&read(&dead), 0.05);
    assert!(checked.ok, "{:?}", checked.outcome);
    let load = r#"{ "on": 4, "force": 100 }"#;
    for (pins, slide, said) in [
        (r#""A": { "f": 0.1 }"#, "", "`radius` or `diameter`"),
        (r#""A": { "radius": 5, "f": 0.1, "circle": 2 }"#, "", "not both"),
        (r#""A": { "circle": -2 }"#, "", "not negative"),
        (r#""A": { "radius": 5, "f": -0.1 }"#, "", "not negative"),
        (r#""A": { "radius": 5, "f": "95 deg" }"#, "", "between 0 and 90"),
        ("", r#""f": [1],"#, "coefficient of friction"),
        ("", r#""drag": -3,"#, "not negative"),
        ("", r#""drag": "3 kg","#, "measures a mass"),
    ] {
        let told = refusal(&crank(1.0, load, pins, slide, r#""T(2)""#));
        assert!(told.contains(said), "{told}");
    }
    let still = refusal(&crank(0.0, load, PINS, "", r#""T(2)""#));
    assert!(still.contains("no input moves"), "{still}");
    // No friction at all is none.
    let none = crank(1.0, load, r#""A": { "radius": 5, "f": 0 }"#, r#""f": 0, "drag": 0,"#, r#""T(2)""#);
    assert!(read(&none).mechanism.forces.friction.is_empty());
}

/// A random chain that rubs at pins and in guides.
/// The worst difference of both solvers in bounds, nothing where both refuse alike, or what contradicts.
fn run_chain(seed: u64, groups: usize) -> Result<Option<f64>, String> {
    let mut chain = Chain::new(seed);
    for group in 0..groups {
        chain.hang(group);
    }
    // A chain on which the dice lay no load is asked for its forces only once it rubs.
    let mut scene: serde_json::Value = serde_json::from_str(&chain.text(&[])).unwrap();
    scene.as_object_mut().unwrap().remove("find");
    let plain = read(&scene.to_string());
    let mut pins = serde_json::Map::new();
    for point in &plain.mechanism.points {
        let links = &point.links;
        if links.len() < 2 || chain.dice.one_in(3) {
            continue;
        }
        let carrier = plain.mechanism.link(links[0]).number;
        let pin = serde_json::json!({ "circle": chain.dice.within(0.001, 0.06), "carrier": carrier });
        pins.insert(point.name.clone(), pin);
    }
    for slide in scene["slides"].as_array_mut().unwrap() {
        if !chain.dice.one_in(3) {
            slide["f"] = chain.dice.within(0.02, 0.2).into();
        }
        if chain.dice.one_in(4) {
            slide["drag"] = chain.dice.within(0.1, 3.0).into();
        }
    }
    scene["pins"] = pins.into();
    let scene = read(&scene.to_string());
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene);
    let Ok(solved) = solved else { return Ok(None) };
    let agreement = check::agreement(&scene, &solved, &linkgram::solve::solve_analytically(&scene));
    if !agreement.ok() {
        let (refused, power) = (&agreement.refused, &agreement.power);
        return Err(format!("seed {seed}: {refused:?} {power:?} {:?}", agreement.disagreements().first()));
    }
    let answered = agreement.compared.iter().all(|compared| compared.difference.is_some());
    Ok(answered.then(|| agreement.worst_ratio()))
}

fn campaign(seeds: std::ops::Range<u64>) -> (usize, usize, f64) {
    let (mut done, mut left, mut worst, mut apart) = (0, 0, 0.0_f64, Vec::new());
    for seed in seeds {
        match run_chain(seed, 1 + (seed % 5) as usize) {
            Ok(Some(ratio)) => {
                done += 1;
                worst = worst.max(ratio);
            }
            Ok(None) => left += 1,
            Err(how) => apart.push(how),
        }
    }
    assert!(apart.is_empty(), "{} of {done} chains contradict:\n{}", apart.len(), apart.join("\n"));
    (done, left, worst)
}

#[test]
fn random_chains_that_rub_agree() {
    let (done, left, worst) = campaign(0..20);
    assert!(done >= 10, "{done} done, {left} left out, worst {worst}");
}

/// The campaign: `cargo test --release --test all friction:: -- --ignored --nocapture`; `LINKGRAM_CHAINS` says how many,
/// `LINKGRAM_FIRST` the first seed.
#[test]
#[ignore = "long"]
fn many_random_chains_that_rub() {
    let many = std::env::var("LINKGRAM_CHAINS").ok().and_then(|n| n.parse().ok()).unwrap_or(1000);
    let first = std::env::var("LINKGRAM_FIRST").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    let (done, left, worst) = campaign(first..first + many);
    println!(
        "{done} chains with friction by both solvers, {left} refused, worst difference {worst} of the bounds"
    );
    assert!(done as u64 > many / 2);
}

/// The public case holds.
#[test]
fn the_independently_computed_case_holds() {
    let checked = check::check(&common::example("forces/friction-slider-crank"), 0.05);
    assert!(checked.ok, "{:?}", checked.outcome);
}

/// A link rides with one guide square to the crank and with another, which drags, in the link 4, on which else a couple
/// acts: the whole force between the two has the moment of that couple about O4. Nothing presses it otherwise, so that
/// its line stands off by couple over drag. An answer along another line is not confirmed.
#[test]
fn a_drag_has_a_line_and_the_line_is_checked() {
    let scene = |couple: f64| {
        scene::read(
            &format!(
                r#"{{ "fixed": {{ "O2": [0, 0], "O4": [0.06, 0.02] }},
              "links": {{ "2": {{ "joins": ["O2", "A"], "length": 0.1 }}, "3": {{ "joins": ["C"] }}, "4": {{ "joins": ["O4"] }} }},
              "slides": [ {{ "link": 3, "turned": 90, "on": {{ "link": 2, "through": "O2", "angle": 0 }} }},
                          {{ "link": 3, "on": {{ "link": 4, "through": [0.01, 0], "angle": 90 }}, "drag": 200 }} ],
              "near": {{ "C": [0.07, 0] }}, "input": {{ "link": 2, "angle": 0, "omega": "10 rad/s cw" }},
              "loads": [ {{ "on": 4, "torque": "{couple} N*m ccw" }} ],
              "find": ["F(3,4)", "moment(F(3,4),O4)", "F(2,3)", "T(2)"] }}"#
            ),
            "drag.json",
        )
        .unwrap()
    };
    let given = scene(5.0);
    let solved = solve(&given, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&given, &solved, &linkgram::solve::solve_analytically(&given));
    assert!(agreement.ok(), "{:?}", agreement.disagreements());
    let answers = &solved.solution.construction.answers;
    let Answer::Vector { value, .. } = answers[0].answer else { panic!("{:?}", answers[0]) };
    assert!(libm::hypot(value[0], value[1] + 200.0) < 1e-9, "{value:?}");
    let [x, _] = answers[0].through.unwrap();
    assert!((x - (0.06 + 5.0 / 200.0)).abs() < 1e-12, "{x}");
    let Answer::Scalar { value, .. } = answers[1].answer else { panic!("{:?}", answers[1]) };
    assert!((value + 5.0).abs() < 1e-9, "{value}");
    // The same forces, but for their lines.
    let mut plain = scene(5.0);
    plain.mechanism.asked.truncate(1);
    let mut other = scene(5.001);
    other.mechanism.asked.truncate(1);
    let solved = solve(&plain, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    assert!(check::agreement(&plain, &solved, &linkgram::solve::solve_analytically(&plain)).ok());
    let told = check::agreement(&plain, &solved, &linkgram::solve::solve_analytically(&other));
    assert!(!told.ok() && told.compared.iter().all(check::Compared::agrees));
    assert!(told.disagreements()[0].name.starts_with("moment(F(3,4),"), "{:?}", told.disagreements());
}

/// One link about O2, with a friction circle r, an upward load P at the arm p and an upward sought load Q at the arm q: the
/// pin holds −(P + Q), and turning ccw P p + Q q − r |P + Q| = 0. Either side of the bars is a line of its own: where
/// q < r and p > q both hold, Q = P (p − r)/(r − q) and Q = −P (p + r)/(q + r).
#[test]
fn pins_alone_may_leave_two_balances() {
    let scene = |circle: f64, expect: &str| {
        read(&format!(
            r#"{{ "fixed": {{ "O2": [0, 0] }}, "links": {{ "2": {{ "joins": ["O2", "A", "B"], "line": [0, 1, 3] }} }},
                 "input": {{ "link": 2, "angle": 0, "omega": 1 }}, "pins": {{ "O2": {{ "circle": {circle} }} }},
                 "loads": [ {{ "name": "P", "on": 2, "at": "B", "force": 100, "direction": 90 }},
                            {{ "name": "Q", "on": 2, "at": "A", "force": "?", "direction": 90 }} ],
                 {expect} "find": ["load(Q)", "F(1,2)"] }}"#
        ))
    };
    let found = answers(&scene(0.5, ""));
    near(found["load(Q)"][1], -100.0 * 3.5 / 1.5);
    let several = scene(2.0, r#""expect": "ambiguous","#);
    assert!(check::check(&several, 0.0).ok, "{:?}", check::check(&several, 0.0).outcome);
    let state = linkgram::solve::solve_analytically(&several).unwrap();
    let told = format!("{:?}", state.answer(&several.mechanism.asked[0].quantity));
    assert!(told.contains("Ambiguous"), "{told}");
}

/// A rack that rides to the right under a wheel that turns ccw: what drags it is more than what pulls it, so that the wheel
/// drives it, though without the drag it would drive the wheel. Teeth push apart by tan 20° of what they drive.
#[test]
fn friction_turns_the_flank_of_teeth_round() {
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
             "links": { "2": { "joins": ["O2"] }, "3": { "joins": ["B", "E"] } },
             "slides": [ { "link": 3, "on": { "link": 1, "through": [0, -30], "angle": 0 }, "drag": 20 } ],
             "rolls": [ { "links": [2, 3], "line": { "link": 3, "through": "B", "toward": "E" }, "centre": "O2",
                          "radius": 30, "pressure": 20 } ],
             "placed": { "B": [-20, -30], "E": [100, -30] }, "input": { "link": 2, "omega": "10 rad/s ccw" },
             "loads": [ { "on": 3, "at": "E", "force": 10, "direction": "with" } ],
             "find": ["F(2,3)", "T(2)"] }"#,
    );
    let found = answers(&scene);
    near(found["F(2,3)"][0], 20.0 - 10.0);
    near(found["F(2,3)"][1], -10.0 * libm::tan(20.0_f64.to_radians()));
    near(found["T(2)"][0], 10.0 * 0.03);
}

/// Two wheels, the driving one with a friction circle at its pin; what the driven one can hold is sought. The pin holds
/// what teeth drive and what they push apart: 30 t − 6000 = 4 √((t tan 20°)² + (100 + t)²), newtons and millimetres.
#[test]
fn what_is_sought_behind_teeth_leans_as_the_teeth_will() {
    let found = answers(&read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O3": [90, 0] },
             "links": { "2": { "joins": ["O2"] }, "3": { "joins": ["O3"] } },
             "rolls": [ { "links": [2, 3], "centres": ["O2", "O3"], "radii": [30, 60], "pressure": 20 } ],
             "input": { "link": 2, "omega": "10 rad/s ccw" }, "pins": { "O2": { "circle": 4 } },
             "loads": [ { "on": 2, "torque": "6 N*m cw" }, { "on": 2, "at": "O2", "force": 100, "direction": 90 },
                        { "name": "Q", "on": 3, "torque": "?" } ],
             "find": ["F(2,3)", "load(Q)"] }"#,
    ));
    let tan = libm::tan(20.0_f64.to_radians());
    let (a, b, c) = (900.0 - 16.0 * (tan * tan + 1.0), -2.0 * (180_000.0 + 1600.0), 3.6e7 - 160_000.0);
    let t = (-b + libm::sqrt(b * b - 4.0 * a * c)) / (2.0 * a);
    near(found["F(2,3)"][1], -t);
    near(found["F(2,3)"][0], t * tan);
    near(found["load(Q)"][0], -0.06 * t);
}

/// A cylinder that swings about O4 and drives a crank by its piston, whose pin rubs. The piston rod is a member of two
/// forces but for the couple of its pin, which the cylinder keeps: with the line A–O4 at the distance l and the circle r,
/// the lever feels r √(N² + D²) = N l, square to the rod N and along it D; moments of the crank about O2 give D.
#[test]
fn a_driven_cylinder_rubs_at_its_pin() {
    let found = answers(&read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [180, 0] },
             "links": { "2": { "joins": ["O2", "A"], "length": 90 }, "3": { "joins": ["A"] }, "4": { "joins": ["O4"] } },
             "slides": [ { "link": 3, "on": { "link": 4, "through": "O4", "angle": 0 } } ],
             "near": { "A": [20, 85] }, "pins": { "A": { "circle": 3 } },
             "input": { "slide": 3, "at": 190, "velocity": 100 },
             "loads": [ { "on": 2, "torque": "5 N*m ccw" } ],
             "find": ["F(3,4)", "drive(3)", "F(1,2)", "x(A)"] }"#,
    ));
    let [n, d] = [libm::hypot(found["F(3,4)"][0], found["F(3,4)"][1]), found["drive(3)"][0].abs()];
    near(n * 0.19, 0.003 * libm::hypot(n, d));
    // The crank: its pin O2 holds what the piston pushes, whose line passes A by the circle.
    let ([x, y], [fx, fy]) = ([found["x(A)"][0], found["x(A)"][1]], [found["F(1,2)"][0], found["F(1,2)"][1]]);
    let [along, size] = [5.0 - (x * fy - y * fx), libm::hypot(fx, fy)];
    near(along.abs(), 0.003 * size);
    near(size, libm::hypot(n, d));
}

/// What nothing presses rubs no more than rounding does: a crank on which nothing acts, where something else balances the
/// load; a rack on which a couple acts that its guide keeps, and one on which nothing acts at all.
#[test]
fn what_nothing_presses_does_not_rub() {
    let scene = |pins: &str| {
        read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [100, 0] }},
              "links": {{ "2": {{ "joins": ["O2", "A"], "length": 50 }}, "3": {{ "joins": ["A", "B"], "length": 100 }},
                          "4": {{ "joins": ["O4", "B"], "length": 80 }} }},
              "near": {{ "B": [110, 80] }}, "input": {{ "link": 2, "angle": 60, "omega": "10 rad/s cw" }}, {pins}
              "loads": [ {{ "on": 4, "torque": "5 N*m ccw" }},
                         {{ "name": "Q", "on": 4, "at": "B", "force": "?", "direction": 0 }} ],
              "find": ["F(2,3)", "F(1,2)", "load(Q)", "x(B)"] }}"#
        ))
    };
    let found = answers(&scene(r#""pins": { "O2": { "circle": 2 } },"#));
    near(found["load(Q)"][0], 5.0 / found["x(B)"][1]);
    for name in ["F(2,3)", "F(1,2)"] {
        near(libm::hypot(found[name][0], found[name][1]), 0.0);
    }
    let rack = |teeth: &str, loads: &str| {
        answers(&read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
              "links": {{ "2": {{ "joins": ["O2"] }}, "3": {{ "joins": ["B", "E"] }} }},
              "slides": [ {{ "link": 3, "on": {{ "link": 1, "through": [9, -30], "angle": 0 }}, "f": 0.1 }} ],
              "rolls": [ {{ "links": [2, 3], "line": {{ "link": 3, "through": "B", "toward": "E" }}, "centre": "O2", "radius": 30 {teeth} }} ],
              "placed": {{ "B": [-20, -30], "E": [100, -30] }}, "input": {{ "link": 2, "omega": "10 rad/s ccw" }},
              "loads": [ {loads} ], "find": ["F(2,3)", "F(1,3)", "T(2)"] }}"#
        )))
    };
    let found =
        rack("", r#"{ "on": 3, "torque": "5 N*m" }, { "on": 3, "at": "E", "force": 100, "direction": 180 }"#);
    near(found["F(2,3)"][0], 100.0);
    near(found["T(2)"][0], 3.0);
    near(libm::hypot(found["F(1,3)"][0], found["F(1,3)"][1]), 0.0);
    let found = rack(r#", "pressure": 20"#, r#"{ "on": 2, "torque": "0.2 N*m cw" }"#);
    near(found["T(2)"][0], 0.2);
}

/// A wheel that rolls to the left draws a rod after it, at whose end a slide drags: the rod lifts the wheel by the slope of
/// its line. Held down with more than that it presses on the ground; with less it would have to pull, and nothing locks.
#[test]
fn friction_that_lifts_a_wheel_leaves_no_equilibrium() {
    let scene = |load: f64, expect: &str| {
        read(&format!(
            r#"{{ "fixed": {{}}, "links": {{ "2": {{ "joins": ["C", "E"] }}, "3": {{ "joins": ["C", "D"] }} }},
              "slides": [ {{ "pin": "D", "block": 4, "on": {{ "link": 1, "through": [0, 2], "angle": 0 }}, "drag": 10 }} ],
              "rolls": [ {{ "links": [1, 2], "line": {{ "link": 1, "through": [0, 0], "angle": 0 }}, "centre": "C", "radius": 1 }} ],
              "placed": {{ "C": [0, 1], "E": [0.5, 1], "D": [3, 2] }}, "input": {{ "link": 2, "omega": 1 }},
              "loads": [ {{ "on": 2, "at": "C", "force": {load}, "direction": -90 }} ], {expect}
              "find": ["F(1,2)", "T(2)"] }}"#
        ))
    };
    let found = answers(&scene(5.0, ""));
    near(found["F(1,2)"][1], 5.0 - 10.0 / 3.0);
    near(found["F(1,2)"][0], -10.0);
    near(found["T(2)"][0], 10.0);
    let checked = check::check(&scene(3.0, r#""expect": "no-equilibrium","#), 0.0);
    assert!(checked.ok, "{:?}", checked.outcome);
}

/// The loaded slider-crank of the closed form has a second rod at its crank pin, on which nothing acts, and whose steep slide
/// would lock at f = cot β if anything pressed it. Whichever way its guide is directed it holds nothing up: the torque is
/// that of the loaded rod alone.
#[test]
fn what_nothing_presses_does_not_lock() {
    let beta = libm::asin(60.0 * libm::sin(50.0_f64.to_radians()) / 70.0);
    let steep = 1.3 / libm::tan(beta);
    for angle in [0, 180] {
        for turn in [1.0, -1.0] {
            let scene = format!(
                r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
                "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 220 }},
                            "5": {{ "joins": ["A", "C"], "length": 70 }} }},
                "slides": [ {{ "pin": "B", "block": 4, "f": 0.1, "on": {{ "link": 1, "through": "O2" }} }},
                            {{ "pin": "C", "block": 6, "f": {steep},
                               "on": {{ "link": 1, "through": "O2", "angle": {angle} }} }} ],
                "near": {{ "B": [240, 0], "C": [90, 0] }},
                "input": {{ "link": 2, "angle": 50, "omega": {} }}, "pins": {{ "C": {{ "circle": 2 }} }},
                "loads": [ {{ "on": 4, "force": 1500, "direction": 0 }} ],
                "find": [ "T(2)", "F(1,6)", "F(5,6)" ] }}"#,
                10.0 * turn
            );
            let found = answers(&read(&scene));
            near(found["T(2)"][0], by_tangents(1500.0, [0.0; 3], 0.1 * turn, 1.0));
            for name in ["F(1,6)", "F(5,6)"] {
                near(libm::hypot(found[name][0], found[name][1]), 0.0);
            }
        }
    }
}

/// The link of two balances, with a circle r = 2 and arms 3 and 1: Q = −5/3 P or Q = P. A slide that hangs on it by a rod
/// and carries a thousand millionth of P has no say in which of them holds, whatever side of its guide is pressed.
#[test]
fn two_balances_are_seen_beside_a_light_slide() {
    let scene = |circle: f64, light: f64, expect: &str| {
        read(&format!(
            r#"{{ "fixed": {{ "O2": [0, 0] }}, "near": {{ "D": [6, 2] }},
                 "links": {{ "2": {{ "joins": ["O2", "A", "B"], "line": [0, 1, 3] }},
                            "3": {{ "joins": ["B", "D"], "length": {} }} }},
                 "slides": [ {{ "pin": "D", "block": 4, "f": 0.1,
                                "on": {{ "link": 1, "through": [6, 0], "angle": 90 }} }} ],
                 "input": {{ "link": 2, "angle": 0, "omega": 1 }}, "pins": {{ "O2": {{ "circle": {circle} }} }},
                 "loads": [ {{ "name": "P", "on": 2, "at": "B", "force": 12e9, "direction": 90 }},
                            {{ "name": "Q", "on": 2, "at": "A", "force": "?", "direction": 90 }},
                            {{ "on": 4, "force": {light}, "direction": -90 }} ],
                 {expect} "find": ["load(Q)", "F(1,4)"] }}"#,
            libm::sqrt(13.0)
        ))
    };
    // The rod rises by 2 in 3, and the guide, which slides upwards, holds it back: V = L + 0.1 · 1.5 V.
    let found = answers(&scene(0.5, 100.0, ""));
    near(found["load(Q)"][1], -(12e9 - 100.0 / 0.85) * 3.5 / 1.5);
    near(found["F(1,4)"][0].abs(), 150.0 / (1.0 - 0.15));
    // The other way up the rod is pulled, and the guide is pressed by 25.5 N, or 22.2 N where it leans.
    for light in [10.0, -17.0] {
        let several = scene(2.0, light, r#""expect": "ambiguous","#);
        let checked = check::check(&several, 0.0);
        assert!(checked.ok, "{:?}", checked.outcome);
    }
}

/// The guide of a slide is pressed by 15/0.85 N where it leans and by 15 N where not, beside forces of thousands of millions
/// of newtons: what stands clear of its own error leans however faint it is beside others.
#[test]
fn a_faint_force_leans_as_any_other() {
    let scene = |loads: [f64; 2]| {
        read(&format!(
            r#"{{ "fixed": {{ "O2": [0, 0] }}, "near": {{ "D": [6, 2] }},
                 "links": {{ "2": {{ "joins": ["O2", "A", "B"], "line": [0, 1, 3] }},
                            "3": {{ "joins": ["B", "D"], "length": {} }} }},
                 "slides": [ {{ "pin": "D", "block": 4, "f": 0.1,
                                "on": {{ "link": 1, "through": [6, 0], "angle": 90 }} }} ],
                 "input": {{ "link": 2, "angle": 0, "omega": 1 }}, "pins": {{ "O2": {{ "circle": 0.5 }} }},
                 "loads": [ {{ "on": 2, "at": "B", "force": {}, "direction": 90 }},
                            {{ "name": "Q", "on": 2, "at": "A", "force": "?", "direction": 90 }},
                            {{ "on": 4, "force": {}, "direction": -90 }} ],
                 "find": ["load(Q)", "F(1,4)"] }}"#,
            libm::sqrt(13.0),
            loads[0],
            loads[1]
        ))
    };
    for heavy in [7e9, 12e9, 13e9, 20e9, 1e12] {
        let found = answers(&scene([heavy, 10.0]));
        near(found["load(Q)"][1], -(heavy - 10.0 / 0.85) * 3.5 / 1.5);
        near(found["F(1,4)"][0].abs(), 15.0 / 0.85);
    }
}
