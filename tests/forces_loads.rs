//! Loads over the angle of the input, torsion springs, several unknowns at once, and what a pair at rest leaves open:
//! against closed forms, virtual work and quadrature of the test's own.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use linkgram::check;
use linkgram::mechanism::quantity::{Answer, Indeterminate};
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::solve::{solve, solve_analytically};
use linkgram::sweep::Sweep;

fn read(text: &str) -> Scene {
    scene::read(text, "loads.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refusal(text: &str) -> String {
    scene::read(text, "loads.json").unwrap_err().to_string()
}

/// Answers by name, of both solvers, which must agree.
fn answers(scene: &Scene) -> BTreeMap<String, Vec<f64>> {
    let solved = solve(scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(scene, &solved, &solve_analytically(scene));
    assert!(agreement.ok(), "{:?} {:?} {:?}", agreement.refused, agreement.disagreements(), agreement.power);
    let readings = &solved.solution.construction.answers;
    let told = scene.mechanism.asked.iter().zip(readings).map(|(asked, reading)| {
        let number = match &reading.answer {
            Answer::Scalar { value, .. } => vec![*value],
            Answer::Vector { value, .. } => value.to_vec(),
            other => panic!("{}: {other:?}", asked.name),
        };
        (asked.name.clone(), number)
    });
    told.collect()
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

/// A slider-crank of 60 and 220 mm at an angle of its crank.
fn crank(angle: &str, more: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 220 }} }},
        "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ],
        "near": {{ "B": [240, 0] }}, "input": {{ "link": 2, {angle} "omega": "10 rad/s ccw" }}, {more} }}"#
    ))
}

/// How far the piston moves towards the crank for a radian, metres.
fn arm(theta: f64) -> f64 {
    let phi = libm::asin(60.0 * libm::sin(theta) / 220.0);
    0.06 * libm::sin(theta + phi) / libm::cos(phi)
}

/// The test's own table: straight between knots, the second of two knots at a leap.
fn table(knots: &[[f64; 2]], period: f64, at: f64) -> f64 {
    let at = knots[0][0] + (at - knots[0][0]).rem_euclid(period);
    let next = knots.iter().position(|knot| knot[0] > at + 1e-9).unwrap_or(knots.len());
    let from = knots[next - 1];
    let to = if next < knots.len() { knots[next] } else { [knots[0][0] + period, knots[0][1]] };
    from[1] + (to[1] - from[1]) * (at - from[0]) / (to[0] - from[0])
}

const PUSH: [[f64; 2]; 6] =
    [[0.0, 2000.0], [90.0, 1000.0], [180.0, 0.0], [180.0, -300.0], [360.0, -300.0], [540.0, 100.0]];

fn push(period: f64) -> String {
    let knots: Vec<String> = PUSH.iter().map(|[at, size]| format!("[{at}, {size}]")).collect();
    format!(
        r#"{{ "name": "P", "on": 4, "force": {{ "table": [{}], "period": {period} }}, "direction": 180 }}"#,
        knots.join(", ")
    )
}

/// A table of forces, harmonics of a torque and a table of pressures at angles between knots, at knots, at a leap and in the
/// second turn; an angle that follows from places is that angle.
#[test]
fn loads_have_the_size_of_their_angle() {
    let harmonics = r#"{ "name": "M", "on": 2, "torque": { "harmonics": { "constant": 3, "sin": [[2, 5]], "cos": [[1, "-4 N*m"], [0.5, 1]] }, "period": 720 } }"#;
    let gas = r#"{ "name": "Q", "on": 4, "pressure": { "table": [[10, "28 bar"], [100, "2 bar"]] }, "bore": 80, "direction": 180 }"#;
    let find = r#""find": ["T(2)", "load(P)", "load(M)", "load(Q)", "F(1,4)"]"#;
    for degrees in [5.0, 50.0, 90.0, 180.0, 200.0, 359.0, 410.0, 540.0, 700.0, -20.0] {
        let theta = f64::to_radians(degrees);
        let scene = crank(
            &format!(r#""angle": {degrees},"#),
            &format!(r#""loads": [ {}, {harmonics}, {gas} ], {find}"#, push(720.0)),
        );
        let found = answers(&scene);
        let force = table(&PUSH, 720.0, degrees);
        let torque = 3.0 + 5.0 * libm::sin(2.0 * theta) - 4.0 * libm::cos(theta) + libm::cos(theta / 2.0);
        let pressure = table(&[[10.0, 28e5], [100.0, 2e5]], 360.0, degrees);
        let gas = pressure * PI / 4.0 * 0.0064;
        near(found["load(P)"][0], -force);
        near(found["load(M)"][0], torque);
        near(found["load(Q)"][0], -gas);
        near(found["T(2)"][0], -(force + gas) * arm(theta) - torque);
    }
    let placed = |load: &str| {
        read(&format!(
            r#"{{ "fixed": {{ "O2": [0, 0] }}, "placed": {{ "A": [-3, -4], "B": [9, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"] }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ],
            "input": {{ "link": 2, "omega": 1 }}, "loads": [ {{ "name": "P", "on": 4, "force": {load} }} ], "find": ["load(P)"] }}"#
        ))
    };
    // The crank stands at 233.13°.
    let angle = (180.0 + libm::atan2(4.0, 3.0).to_degrees()) / 360.0;
    near(answers(&placed(r#"{ "table": [[0, 0], [360, 1]] }"#))["load(P)"][0], angle);
    near(answers(&placed(r#"{ "table": [[0, 0], [720, 1]], "period": 720 }"#))["load(P)"][0], angle / 2.0);
}

/// Over two turns, with knots and a leap in the way, every position is the closed form, and the other solver confirms it.
#[test]
fn a_sweep_follows_the_curves() {
    let scene =
        crank(r#""angle": 50,"#, &format!(r#""loads": [ {} ], "find": ["T(2)", "load(P)"]"#, push(720.0)));
    let sweep = Sweep::new(&scene.mechanism, Some([0.0, 2.0 * TAU])).unwrap();
    let mut seen = 0;
    for position in sweep.positions(&sweep.equal_steps(144)) {
        let force = table(&PUSH, 720.0, position.at.to_degrees());
        near(position.values[0].unwrap(), -force * arm(position.at));
        near(position.values[1].unwrap(), -force);
        seen += 1;
    }
    assert_eq!(seen, 145);
    let one = Sweep::new(&scene.mechanism, None).unwrap();
    check::confirm_sweep(&one).unwrap();
    for place in [0.3, 1.2, 2.0] {
        let mut there = scene.clone();
        there.mechanism = one.mechanism_at(place).unwrap();
        near(answers(&there)["T(2)"][0], -table(&PUSH, 720.0, f64::to_degrees(place)) * arm(place));
    }
    // With bounds: the truth lies within them.
    let bounded = one.with_bounds().unwrap();
    let places = one.equal_steps(90);
    bounded.run(&places, |at, numbers, bounds| {
        let truth = -table(&PUSH, 720.0, at.to_degrees()) * arm(at);
        let room = bounds[0] + 1e-12 * truth.abs().max(1.0);
        assert!(
            (numbers[0] - truth).abs() <= room || bounds[0].is_infinite(),
            "{at}: {} {truth}",
            numbers[0]
        );
    });
}

/// The turning-moment diagram of a mechanism whose load is a table: work and levels by quadrature of the closed form.
#[test]
fn a_cycle_of_a_mechanism_with_curves() {
    let scene = crank(
        r#""angle": 50,"#,
        &format!(
            r#""loads": [ {} ], "cycle": {{ "torque": {{ "of": 2 }}, "period": 720 }}, "find": ["E", "Tmean", "Ef", "Emax", "Emin"]"#,
            push(720.0)
        ),
    );
    let found = answers(&scene);
    // The middle of many small steps, none of which spans a knot.
    let steps = 288_000;
    let step = 2.0 * TAU / f64::from(steps);
    let torque = |at: f64| table(&PUSH, 720.0, at.to_degrees()) * arm(at);
    let work: f64 = (0..steps).map(|k| torque((f64::from(k) + 0.5) * step) * step).sum();
    let mean = work / (2.0 * TAU);
    let (mut level, mut most, mut least) = (0.0_f64, 0.0_f64, 0.0_f64);
    for k in 0..steps {
        level += (torque((f64::from(k) + 0.5) * step) - mean) * step;
        (most, least) = (most.max(level), least.min(level));
    }
    let close = |found: f64, wanted: f64| assert!((found - wanted).abs() < 1e-5, "{found} is not {wanted}");
    close(found["E"][0], work);
    close(found["Tmean"][0], mean);
    close(found["Ef"][0], most - least);
    // Masses move the levels and take no work; both solvers must still agree.
    let heavy = crank(
        r#""angle": 50,"#,
        &format!(
            r#""masses": {{ "4": {{ "mass": 2 }}, "3": {{ "mass": 1.5, "inertia": 0.01, "at": "A" }} }},
            "loads": [ {}, {{ "on": 2, "torque": {{ "harmonics": {{ "sin": [[1, 3]] }} }} }} ],
            "cycle": {{ "torque": {{ "of": 2 }}, "period": 720 }}, "find": ["E", "Ef", "crossing(1)"]"#,
            push(720.0)
        ),
    );
    close(answers(&heavy)["E"][0], work);
    let told = refusal(
        r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 1 } },
            "input": { "link": 2, "angle": 3, "omega": 1 },
            "loads": [ { "on": 2, "torque": { "table": [[0, 1], [90, 3]], "period": 720 } } ],
            "cycle": { "torque": { "of": 2 }, "period": 360 }, "find": ["Ef"] }"#,
    );
    assert!(told.contains("after 2 turns"), "{told}");
}

/// What says nothing is refused where it stands.
#[test]
fn curves_that_say_nothing_are_refused() {
    let with = |input: &str, force: &str| {
        refusal(&format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, "links": {{ "2": {{ "joins": ["O", "A"], "length": 1 }} }},
            {input}, "loads": [ {{ "on": 2, "at": "A", "force": {force} }} ], "find": ["T(2)"] }}"#
        ))
    };
    let turning = r#""input": { "link": 2, "angle": 3, "omega": 1 }"#;
    for (force, what) in [
        (r#"{ "table": [[90, 1], [0, 2]] }"#, "ascend"),
        (r#"{ "table": [] }"#, "knots"),
        ("{}", "the curve is missing"),
        (r#"{ "table": [[0, "2 m"]] }"#, "a force is expected"),
        (r#"{ "table": [[0, 1]], "harmonics": { "constant": 1 } }"#, "not both"),
        (r#"{ "of": 2 }"#, "of"),
    ] {
        let told = with(turning, force);
        assert!(told.contains(what), "{told}");
    }
    let slider = refusal(
        r#"{ "fixed": { "O": [0, 0] }, "placed": { "B": [3, 0] }, "links": { "2": { "joins": ["B", "C"], "length": 1 } },
            "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O" } } ],
            "near": { "C": [4, 0] }, "inputs": [ { "slide": "B", "at": 3 }, { "link": 2, "angle": 3 } ],
            "loads": [ { "on": 4, "force": { "table": [[0, 1]] } } ], "find": ["drive(B)"] }"#,
    );
    assert!(slider.contains("drive a link"), "{slider}");
}

/// A four-bar as the test knows it: angles of links 3 and 4, and their rates for a unit rate of the crank.
fn four_bar(theta: f64) -> [f64; 4] {
    let (a, b, c, d) = (0.06, 0.18, 0.12, 0.2);
    let at = [a * libm::cos(theta), a * libm::sin(theta)];
    let apart = [d - at[0], -at[1]];
    let reach = libm::hypot(apart[0], apart[1]);
    let inner = libm::acos((reach * reach + b * b - c * c) / (2.0 * reach * b));
    let three = libm::atan2(apart[1], apart[0]) + inner;
    let pin = [at[0] + b * libm::cos(three), at[1] + b * libm::sin(three)];
    let four = libm::atan2(pin[1], pin[0] - d);
    let three_rate = a * libm::sin(four - theta) / (b * libm::sin(three - four));
    let four_rate = a * libm::sin(theta - three) / (c * libm::sin(four - three));
    [three, four, three_rate, four_rate]
}

fn rocker(more: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [200, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, "3": {{ "joins": ["A", "B"], "length": 180 }},
            "4": {{ "joins": ["O4", "B"], "length": 120 }} }},
        "near": {{ "B": [160, 110] }}, "input": {{ "link": 2, "angle": 50, "omega": "10 rad/s ccw" }}, {more} }}"#
    ))
}

/// T₂ = −Σ M δφ: a torsion spring to the frame, one between two moving links, a torque of a spring, a stiffness that is
/// sought; over a turn too.
#[test]
fn torsion_springs_are_virtual_work() {
    let [three, four, three_rate, four_rate] = four_bar(50.0_f64.to_radians());
    let found = answers(&rocker(
        r#""springs": [ { "name": "S", "links": [1, 4], "stiffness": 20, "free": 80 }, { "name": "R", "links": [3, 4], "force": "4 N*m cw" },
            { "name": "K", "links": [4, 3], "stiffness": "5 N*m/rad", "free": "-1.2 rad" } ],
           "find": ["T(2)", "spring(S)", "spring(R)", "spring(K)", "moment(F(1,4),B)", "F(3,4)"]"#,
    ));
    let (s, r, k) = (-20.0 * (four - 80.0_f64.to_radians()), -4.0, -5.0 * (three - four + 1.2));
    near(found["spring(S)"][0], s);
    near(found["spring(R)"][0], r);
    near(found["spring(K)"][0], k);
    let work = s * four_rate + r * (four_rate - three_rate) + k * (three_rate - four_rate);
    near(found["T(2)"][0], -work);
    // Of the frame's spring the frame feels no force: link 4 is in balance by its pins and couples.
    near(found["moment(F(1,4),B)"][0], -(s + r - k));
    let sought = answers(&rocker(&format!(
        r#""springs": [ {{ "name": "S", "links": [1, 4], "stiffness": "?", "free": 80 }} ],
           "loads": [ {{ "on": 2, "torque": {} }} ], "find": ["spring(S)"]"#,
        -s * four_rate
    )));
    near(sought["spring(S)"][0], s);
    let scene = rocker(
        r#""springs": [ { "name": "S", "links": [1, 4], "stiffness": 20, "free": 80 } ], "find": ["T(2)", "spring(S)"]"#,
    );
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    check::confirm_sweep(&sweep).unwrap();
    for position in sweep.positions(&sweep.equal_steps(72)) {
        let [_, four, _, four_rate] = four_bar(position.at);
        let torque = -20.0 * (four - 80.0_f64.to_radians());
        near(position.values[1].unwrap(), torque);
        near(position.values[0].unwrap(), -torque * four_rate);
    }
    // The free angle counts within half a turn.
    let wound = rocker(
        r#""springs": [ { "name": "S", "links": [1, 4], "stiffness": 20, "free": 440 } ], "find": ["spring(S)"]"#,
    );
    near(answers(&wound)["spring(S)"][0], s);
    // What it takes it gives back: over a turn no work, whatever the levels.
    let cycle = rocker(
        r#""springs": [ { "links": [1, 4], "stiffness": 20, "free": 80 } ],
           "loads": [ { "on": 2, "torque": 7 } ], "cycle": { "torque": { "of": 2 } }, "find": ["E", "Ef"]"#,
    );
    near(answers(&cycle)["E"][0], 7.0 * TAU);
}

/// Two links, two inputs, and two loads that are sought in the place of both efforts: the closed form of the arm.
#[test]
fn several_unknowns_are_found_at_once() {
    let arm = |more: &str| {
        read(&format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, "links": {{ "2": {{ "joins": ["O", "A"], "length": 2 }}, "3": {{ "joins": ["A", "B"], "length": 1.5 }} }},
            "inputs": [ {{ "link": 2, "angle": 40, "omega": 1 }}, {{ "link": 3, "angle": 100, "omega": -2 }} ], {more} }}"#
        ))
    };
    let (one, two) = (40.0_f64.to_radians(), 100.0_f64.to_radians());
    let efforts =
        answers(&arm(r#""loads": [ { "on": 3, "at": "B", "force": [30, -70] } ], "find": ["T(2)", "T(3)"]"#));
    // Angles of the world are the coordinates: a torque for each.
    let wanted = [
        -(2.0 * (libm::cos(one) * -70.0 - libm::sin(one) * 30.0)),
        -(1.5 * (libm::cos(two) * -70.0 - libm::sin(two) * 30.0)),
    ];
    near(efforts["T(2)"][0], wanted[0]);
    near(efforts["T(3)"][0], wanted[1]);
    // The same force from the torques, sought along two directions in either order.
    for [first, second] in [["X", "Y"], ["Y", "X"]] {
        let of = |name: &str| {
            let angle = if name == "X" { 0 } else { 90 };
            format!(r#"{{ "name": "{name}", "on": 3, "at": "B", "force": "?", "direction": {angle} }}"#)
        };
        let found = answers(&arm(&format!(
            r#""loads": [ {}, {}, {{ "on": 2, "torque": {} }}, {{ "on": 3, "torque": {} }} ], "find": ["load(X)", "load(Y)", "F(2,3)"]"#,
            of(first),
            of(second),
            wanted[0],
            wanted[1]
        )));
        near(found["load(X)"][0], 30.0);
        near(found["load(Y)"][1], -70.0);
        near(found["F(2,3)"][0], -30.0);
        near(found["F(2,3)"][1], 70.0);
    }
    // A spring's stiffness and a torque; three at once.
    let found = answers(&arm(
        r#""loads": [ { "on": 3, "at": "B", "force": [30, -70] }, { "name": "M", "on": 2, "torque": "?" } ],
           "springs": [ { "name": "S", "between": [ { "link": 3, "at": "B" }, { "link": 1, "at": [-4, 1] } ], "stiffness": "?", "free": 1 } ],
           "find": ["load(M)", "spring(S)"]"#,
    ));
    let tip = [2.0 * libm::cos(one) + 1.5 * libm::cos(two), 2.0 * libm::sin(one) + 1.5 * libm::sin(two)];
    let away = [-4.0 - tip[0], 1.0 - tip[1]];
    let long = libm::hypot(away[0], away[1]);
    let unit = away.map(|c| c / long);
    let pull = -(libm::cos(two) * -70.0 - libm::sin(two) * 30.0)
        / (libm::cos(two) * unit[1] - libm::sin(two) * unit[0]);
    near(found["spring(S)"][0], pull);
    let on = [30.0 + pull * unit[0], -70.0 + pull * unit[1]];
    near(found["load(M)"][0], -2.0 * (libm::cos(one) * on[1] - libm::sin(one) * on[0]));
    let three = read(
        r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 2 }, "3": { "joins": ["A", "B"], "length": 1.5 }, "4": { "joins": ["B", "C"], "length": 1 } },
            "inputs": [ { "link": 2, "angle": 40, "omega": 1 }, { "link": 3, "angle": 100, "omega": -2 }, { "link": 4, "angle": 10, "omega": 1 } ],
            "loads": [ { "on": 4, "at": "C", "force": [30, -70] }, { "name": "L", "on": 4, "torque": "?" }, { "name": "M", "on": 2, "torque": "?" },
                { "name": "X", "on": 3, "at": "B", "force": "?", "direction": 0 } ], "find": ["load(L)", "load(M)", "load(X)"] }"#,
    );
    let found = answers(&three);
    let turn = |length: f64, angle: f64, force: [f64; 2]| {
        length * (libm::cos(angle) * force[1] - libm::sin(angle) * force[0])
    };
    near(found["load(L)"][0], -turn(1.0, 10.0_f64.to_radians(), [30.0, -70.0]));
    let x = turn(1.5, two, [30.0, -70.0]) / (1.5 * libm::sin(two));
    near(found["load(X)"][0], x);
    near(found["load(M)"][0], -turn(2.0, one, [30.0 + x, -70.0]));
    // Two loads that do the same work are not told apart.
    let alike = arm(
        r#""loads": [ { "on": 3, "torque": 5 }, { "name": "M", "on": 2, "torque": "?" }, { "name": "N", "on": 2, "torque": "?" } ], "find": ["load(M)"]"#,
    );
    let solved = solve(&alike, Extent::Asked, linkgram::sheet::scale::for_scene);
    let undetermined = match solved {
        Err(_) => true,
        Ok(solved) => matches!(solved.solution.construction.answers[0].answer, Answer::Indeterminate(_)),
    };
    assert!(undetermined);
}

/// The sheet says what a curve comes to, how a torsion spring stands and how several unknowns are found, in every
/// language.
#[test]
fn sheets_tell_it() {
    let scenes = [
        crank(r#""angle": 50,"#, &format!(r#""loads": [ {} ], "find": ["T(2)"]"#, push(720.0))),
        crank(
            r#""angle": 50,"#,
            r#""loads": [ { "name": "Q", "on": 4, "pressure": { "table": [[10, "28 bar"], [100, "2 bar"]] }, "bore": 80, "direction": 180 },
                { "on": 2, "torque": { "harmonics": { "sin": [[2, 5]] } } } ], "find": ["T(2)"]"#,
        ),
        rocker(
            r#""springs": [ { "name": "S", "links": [1, 4], "stiffness": 20, "free": 80 } ], "find": ["T(2)", "F(3,4)"]"#,
        ),
        rocker(
            r#""springs": [ { "name": "R", "links": [3, 4], "force": "4 N*m cw" } ], "find": ["T(2)", "F(3,4)"]"#,
        ),
        read(
            r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 2 }, "3": { "joins": ["A", "B"], "length": 1.5 } },
            "inputs": [ { "link": 2, "angle": 40, "omega": 1 }, { "link": 3, "angle": 100, "omega": -2 } ],
            "loads": [ { "name": "X", "on": 3, "at": "B", "force": "?", "direction": 0 }, { "name": "M", "on": 2, "torque": "?" }, { "on": 3, "torque": 6 } ],
            "find": ["load(X)", "load(M)"] }"#,
        ),
    ];
    for scene in scenes {
        for language in ["en", "ar", "fa"] {
            let mut scene = scene.clone();
            scene.sheet.language = Some(language.to_owned());
            let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default());
            drawn.unwrap_or_else(|error| panic!("{}", error.told(&scene)));
        }
    }
}

/// A pair that rubs and rests leaves open what hangs on its friction, and nothing else: at the dead centre of its slider
/// the other slider's forces are those of its rod.
#[test]
fn a_pair_at_rest_leaves_only_its_own_forces_open() {
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 }, "5": { "joins": ["A", "C"], "length": 200 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" }, "f": 0.1 },
            { "pin": "C", "block": 6, "on": { "link": 1, "through": "O2", "angle": 90 }, "f": 0.2 } ],
        "near": { "B": [280, 0], "C": [0, 190] }, "input": { "link": 2, "angle": 0, "omega": "10 rad/s ccw" },
        "loads": [ { "name": "P", "on": 4, "force": 1500, "direction": 180 }, { "name": "Q", "on": 6, "force": 500, "direction": 270 } ],
        "find": ["F(5,6)", "F(1,6)", "load(P)", "F(3,4)", "F(1,4)"] }"#,
    );
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{:?}", agreement.disagreements());
    for compared in &agreement.compared[..3] {
        assert!(compared.difference.is_some(), "{}: {:?}", compared.asked.name, compared.indeterminate());
    }
    for compared in &agreement.compared[3..] {
        assert!(
            matches!(compared.indeterminate(), Some(Indeterminate::Rubbing { .. })),
            "{}: {:?}",
            compared.asked.name,
            compared.graphical.answer
        );
        assert!(matches!(compared.analytic, Answer::Indeterminate(_)), "{}", compared.asked.name);
    }
    // The block rises: its guide's friction is downwards, 0.2 of the normal force, and the rod is a member of two forces.
    let Answer::Vector { value: rod, .. } = agreement.compared[0].graphical.answer else { panic!() };
    let Answer::Vector { value: guide, .. } = agreement.compared[1].graphical.answer else { panic!() };
    let up = libm::sqrt(200.0 * 200.0 - 3600.0);
    near(rod[0] / rod[1], -60.0 / up);
    near(guide[0], -rod[0]);
    near(guide[1], -0.2 * guide[0].abs());
    near(rod[1] + guide[1], 500.0);
}

/// A block's mass centre and a load beside its pin, in the block's own coordinates: x along its guide. Its guide keeps it
/// from turning, and what it carries on a lever moves as the lever turns: the same body as a link that slides.
#[test]
fn own_coordinates_of_a_block() {
    let scene = crank(
        r#""angle": 50,"#,
        r#""gravity": {}, "masses": { "4": { "mass": 5, "at": [20, 30] } },
           "loads": [ { "on": 4, "at": [20, 30], "force": 100, "direction": 180 } ],
           "find": ["T(2)", "F(1,4)", "moment(F(1,4),B)", "a(G4)", "a(B)"]"#,
    );
    let found = answers(&scene);
    near(found["a(G4)"][0], found["a(B)"][0]);
    let along = -100.0 - 5.0 * found["a(B)"][0];
    near(found["moment(F(1,4),B)"][0], -(0.02 * -49.05 - 0.03 * along));
    let lever = |links: &str, slide: &str| {
        answers(&read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -150] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 60 }}, {links} "4": {{ "joins": ["O4", "C"], "length": 300 }} }},
            "slides": [ {{ {slide}, "on": {{ "link": 4, "through": "O4", "toward": "C" }} }} ],
            "near": {{ "C": [50, 140] }}, "input": {{ "link": 2, "angle": 50, "omega": "10 rad/s ccw" }}, "gravity": {{}},
            "masses": {{ "3": {{ "mass": 5, "inertia": 0.01, "at": [20, 30] }} }}, "loads": [ {{ "on": 4, "at": "C", "force": 100, "direction": 180 }} ],
            "find": ["T(2)", "F(4,3)", "moment(F(4,3),A)", "a(G3)"] }}"#
        )))
    };
    let block = lever("", r#""pin": "A", "block": 3"#);
    let link = lever(
        r#""3": { "joins": ["A", "D"], "shape": { "A": [0, 0], "D": [1, 0] } },"#,
        r#""link": 3, "turned": 0"#,
    );
    for (name, numbers) in &block {
        for (one, other) in numbers.iter().zip(&link[name]) {
            near(*one, *other);
        }
    }
}

/// A block has its pin as its default place also where something else on it has own coordinates: a load off its pin has
/// the same torque at the crank, and the block's mass is at its pin.
#[test]
fn a_block_with_own_coordinates_keeps_its_pin() {
    let torque =
        |more: &str| answers(&crank(r#""angle": 60,"#, &format!(r#"{more}, "find": ["T(2)"]"#)))["T(2)"][0];
    let off = r#"{ "name": "P", "on": 4, "at": [10, 5], "force": 100 }"#;
    let (at, none) = (r#", "at": "B""#, "");
    let masses = [at, none]
        .map(|at| torque(&format!(r#""masses": {{ "4": {{ "mass": 2{at} }} }}, "loads": [ {off} ]"#)));
    near(masses[0], masses[1]);
    let loads = [at, none]
        .map(|at| torque(&format!(r#""loads": [ {off}, {{ "name": "Q", "on": 4, "force": 50{at} }} ]"#)));
    near(loads[0], loads[1]);
    // Off its pin or at it: a block does not turn.
    near(torque(&format!(r#""loads": [ {off} ]"#)), torque(r#""loads": [ { "on": 4, "force": 100 } ]"#));
}

/// A yoke has one joint and a guide, and own coordinates along it: a load on it works as at its joint, and its guide keeps
/// the couple. A cylinder that swings has them along its bore, towards its driven piston.
#[test]
fn a_link_of_one_joint_has_own_coordinates_along_its_guide() {
    let found = answers(&read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
             "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "4": { "joins": ["C"] } },
             "slides": [ { "link": 4, "on": { "link": 1, "through": "O2", "angle": 0 } },
                         { "pin": "A", "block": 3, "on": { "link": 4, "through": "C", "angle": 90 } } ],
             "input": { "link": 2, "angle": 55, "omega": "10 rad/s ccw" },
             "loads": [ { "on": 4, "at": [40, 10], "force": 200, "direction": 180 } ], "find": ["T(2)", "moment(F(1,4),C)"] }"#,
    ));
    let sine = libm::sin(55.0_f64.to_radians());
    near(found["T(2)"][0], -200.0 * 0.05 * sine);
    // The crank pushes back at the height of its pin, the load stands 10 mm above the guide.
    near(found["moment(F(1,4),C)"][0], 200.0 * 0.05 * sine - 200.0 * 0.01);
    let found = answers(&read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [180, 0] },
             "links": { "2": { "joins": ["O2", "A"], "length": 90 }, "3": { "joins": ["A"] }, "4": { "joins": ["O4"] } },
             "slides": [ { "link": 3, "on": { "link": 4, "through": "O4", "angle": 0 } } ],
             "near": { "A": [20, 85] }, "input": { "slide": 3, "at": 190, "velocity": 100 },
             "masses": { "4": { "mass": 2, "at": [30, 40] } }, "find": ["x(A)", "x(G4)", "drive(3)"] }"#,
    ));
    let (x, y) = (found["x(A)"][0] - 0.18, found["x(A)"][1]);
    near(found["x(G4)"][0], 0.18 + (0.03 * x - 0.04 * y) / 0.19);
    near(found["x(G4)"][1], (0.03 * y + 0.04 * x) / 0.19);
}

/// A torsion spring has N m for a radian unless its unit, or that of the scene, says otherwise.
#[test]
fn the_stiffness_of_a_torsion_spring_has_its_unit() {
    let torque = |units: &str, stiffness: &str| {
        answers(&read(&format!(
            r#"{{ "units": {{ "length": "mm" {units} }}, "fixed": {{ "O": [0, 0] }}, "links": {{ "2": {{ "joins": ["O", "A"], "length": 50 }} }},
              "input": {{ "link": 2, "angle": 30 }}, "find": ["spring(S)"],
              "springs": [ {{ "name": "S", "links": [1, 2], "stiffness": {stiffness}, "free": 0 }} ] }}"#
        )))["spring(S)"][0]
    };
    let turned = 30.0_f64.to_radians();
    near(torque(r#", "torque": "N*mm""#, "100"), -100.0 * turned);
    near(torque("", r#""100 N*mm/rad""#), -0.1 * turned);
    near(torque(r#", "stiffness": "N*mm/rad""#, "100"), -0.1 * turned);
}

/// What a guide exerts on a link that rides on it acts at the link's first joint, whether or not that is asked. A yoke: the
/// load (-94, -34.2) N at D, the pin's push along the ride at A, the guide's push square to it, and its couple.
#[test]
fn the_moment_of_a_ride_needs_no_other_question() {
    let scene = read(
        r#"{ "fixed": { "O2": [0, 0] }, "placed": { "A": [3, 2], "C": [-4, 1], "D": [-1, 4] },
             "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["C", "D"] } },
             "slides": [ { "link": 3, "on": { "link": 1, "through": [-4, 1], "angle": 0 } },
                         { "pin": "A", "on": { "link": 3, "through": [3, 2], "angle": 90 } } ],
             "input": { "link": 2, "omega": 3 },
             "loads": [ { "on": 3, "at": "D", "force": 100, "direction": 200 } ], "find": ["moment(F(1,3),O2)"] }"#,
    );
    let (sine, cosine) = libm::sincos(200.0_f64.to_radians());
    let load = [100.0 * cosine, 100.0 * sine];
    let of_load = -load[1] - 4.0 * load[0];
    let of_pin = 2.0 * load[0];
    near(answers(&scene)["moment(F(1,3),O2)"][0], -(of_load + of_pin));
}

/// A block has own coordinates along its guide whether or not anything but its pin is on it: a load in its own direction,
/// against the work of it alone.
#[test]
fn a_load_in_the_direction_of_a_block_needs_no_point_beside_its_pin() {
    for load in
        [r#""force": 100, "direction": { "link": 4, "angle": 180 }"#, r#""force": [-100, 0], "in": 4"#]
    {
        let more = format!(r#""loads": [ {{ "name": "P", "on": 4, {load} }} ], "find": ["T(2)"]"#);
        near(answers(&crank(r#""angle": 50,"#, &more))["T(2)"][0], -100.0 * arm(50_f64.to_radians()));
    }
    // In the slot of a lever: 30 N along the slot, outward, at A.
    let scene = read(
        r#"{ "fixed": { "O2": [0, 0], "O3": [-0.2, -0.1] }, "links": { "2": { "joins": ["O2", "A"], "length": 0.1 },
            "3": { "joins": ["O3"] } }, "slides": [ { "pin": "A", "block": 4, "on": { "link": 3, "through": "O3" } } ],
            "input": { "link": 2, "angle": 70, "omega": 3 },
            "loads": [ { "name": "P", "on": 4, "force": 30, "direction": { "link": 4, "angle": 0 } } ], "find": ["T(2)"] }"#,
    );
    let (sin, cos) = libm::sincos(70_f64.to_radians());
    let slot = [0.1 * cos + 0.2, 0.1 * sin + 0.1];
    let power = 30.0 * (-0.1 * sin * slot[0] + 0.1 * cos * slot[1]) / libm::hypot(slot[0], slot[1]);
    near(answers(&scene)["T(2)"][0], -power);
}

/// A rack on a pinion that nothing holds but this rack, driven along its guide, and one at rest: a wheel of 50 mm about C.
fn between_racks(more: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }},
        "placed": {{ "C": [0, 50], "R": [0, 100], "E": [10, 60] }}, "fixed": {{ "Z": [0, 0] }},
        "links": {{ "2": {{ "joins": ["R"] }}, "3": {{ "joins": ["C", "E"] }} }},
        "rolls": [
            {{ "links": [1, 3], "line": {{ "link": 1, "through": "Z" }}, "centre": "C", "teeth": 25, "module": 4 }},
            {{ "links": [2, 3], "line": {{ "link": 2, "through": "R" }}, "centre": "C", "teeth": 25, "module": 4 }} ],
        "slides": [ {{ "link": 2, "on": {{ "link": 1, "through": [0, 100] }} }} ],
        "loads": [ {{ "name": "P", "on": 3, "at": "C", "force": -100, "direction": 0 }} ],
        "find": ["drive(2)", "F(2,3)", "F(1,3)", "F(1,2)"], {more} }}"#
    ))
}

/// Moments about C and the balance along the racks give both forces along the pitch lines, the angle of pressure what pushes
/// apart: the pinion rests on the rack that is fixed.
#[test]
fn a_pinion_between_two_racks_is_pushed_by_both() {
    let tangent = libm::tan(20.0_f64.to_radians());
    let found = answers(&between_racks(r#""input": { "slide": 2, "velocity": "0.5 m/s" }"#));
    near(found["drive(2)"][0], 50.0);
    for (name, wanted) in [
        ("F(2,3)", [50.0, -50.0 * tangent]),
        ("F(1,3)", [50.0, 50.0 * tangent]),
        ("F(1,2)", [0.0, -50.0 * tangent]),
    ] {
        near(found[name][0], wanted[0]);
        near(found[name][1], wanted[1]);
    }
    // The rack has 3 m/s², the centre half of it, and the wheel turns at 3 / 0.1 rad/s² cw.
    let found = answers(&between_racks(
        r#""input": { "slide": 2, "velocity": "0.5 m/s", "acceleration": "3 m/s^2" }, "gravity": {},
        "masses": { "3": { "mass": 6, "inertia": 0.008, "at": "C" }, "2": { "mass": 4 } }"#,
    ));
    let (sum, difference) = (100.0 + 6.0 * 1.5, 0.008 * 30.0 / 0.05);
    let (driven, fixed) = ((sum + difference) / 2.0, (sum - difference) / 2.0);
    near(found["drive(2)"][0], driven + 4.0 * 3.0);
    near(found["F(2,3)"][0], driven);
    near(found["F(2,3)"][1], -driven * tangent);
    near(found["F(1,3)"][0], fixed);
    near(found["F(1,3)"][1], 6.0 * 9.81 + driven * tangent);
}

/// A planet of 30 mm that nothing holds but a sun of 30 mm and a ring of 90 mm that is fixed.
fn planet_alone(rolls: [&str; 2], force: [f64; 2]) -> BTreeMap<String, Vec<f64>> {
    let [sun, ring] = rolls;
    let [x, y] = force;
    answers(&read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }},
        "placed": {{ "B": [0, 20], "A": [60, 0], "E": [70, 0] }},
        "links": {{ "2": {{ "joins": ["O", "B"] }}, "3": {{ "joins": ["A", "E"] }} }},
        "rolls": [ {{ "links": [2, 3], "centres": ["O", "A"], {sun} }},
                   {{ "links": [1, 3], "centres": ["O", "A"], "internal": true, {ring} }} ],
        "input": {{ "link": 2, "omega": "10 rad/s ccw" }},
        "loads": [ {{ "name": "P", "on": 3, "at": "A", "force": [{x}, {y}] }} ],
        "find": ["T(2)", "F(2,3)", "F(1,3)"] }}"#
    )))
}

/// Half of what acts across the line of centres goes to each of sun and ring. What acts along it the sun carries, whose contact
/// the wheel keeps, and what teeth of the ring push inwards.
#[test]
fn a_planet_without_an_arm_rests_on_its_sun() {
    let found = planet_alone([r#""radii": [30, 30]"#, r#""radii": [90, 30]"#], [-50.0, -100.0]);
    near(found["T(2)"][0], 1.5);
    for (name, wanted) in [("F(2,3)", [50.0, 50.0]), ("F(1,3)", [0.0, 50.0])] {
        near(found[name][0], wanted[0]);
        near(found[name][1], wanted[1]);
    }
    let found = planet_alone(
        [r#""teeth": [20, 20], "module": 3"#, r#""teeth": [60, 20], "module": 3"#],
        [0.0, -100.0],
    );
    let apart = 50.0 * libm::tan(20.0_f64.to_radians());
    for (name, wanted) in [("F(2,3)", [apart, 50.0]), ("F(1,3)", [-apart, 50.0])] {
        near(found[name][0], wanted[0]);
        near(found[name][1], wanted[1]);
    }
}

/// A four-bar of 40, 140 and 90 mm on pins 150 mm apart, with a torsion spring of 5 N m/rad between two of its links.
fn with_torsion(degrees: f64, links: [u32; 2], free: f64) -> Scene {
    let [first, second] = links;
    read(&format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [150, 0] }},
        "links": {{ "2": {{ "joins": ["O2", "A"], "length": 40 }}, "3": {{ "joins": ["A", "B"], "length": 140 }},
                   "4": {{ "joins": ["O4", "B"], "length": 90 }} }},
        "near": {{ "B": [140, 90] }}, "input": {{ "link": 2, "angle": {degrees}, "omega": 1 }},
        "springs": [ {{ "name": "K", "links": [{first}, {second}], "stiffness": 5, "free": {free} }} ],
        "find": ["spring(K)", "T(2)"] }}"#
    ))
}

/// The angle of the rocker of that four-bar, by the law of cosines.
fn angle_of_rocker(theta: f64) -> f64 {
    let (sin, cos) = libm::sincos(theta);
    let (x, y) = (0.04 * cos - 0.15, 0.04 * sin);
    let away = libm::hypot(x, y);
    let inner = libm::acos((0.09 * 0.09 + away * away - 0.14 * 0.14) / (2.0 * 0.09 * away));
    libm::atan2(y, x).rem_euclid(TAU) - inner
}

fn within_half_a_turn(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// From the scene's own place on, where it is within half a turn of its free angle, a spring is wound up by what its links turn:
/// k (φ − φ₀) with an angle that goes on, over the whole turn of the crank.
#[test]
fn a_torsion_spring_is_wound_up_over_the_turn() {
    for (degrees, links, free) in
        [(20.0, [1, 2], 80.0), (100.0, [1, 2], 80.0), (300.0, [1, 2], 80.0), (400.0, [1, 2], 80.0)]
            .into_iter()
            .chain([(100.0, [2, 4], -10.0), (250.0, [2, 4], -10.0), (30.0, [4, 2], 200.0)])
    {
        let scene = with_torsion(degrees, links, free);
        let sweep = Sweep::new(&scene.mechanism, None).unwrap();
        check::confirm_sweep(&sweep).unwrap_or_else(|why| panic!("{degrees} {links:?}: {why:?}"));
        let column = sweep.columns.iter().position(|c| c.asked.name == "spring(K)").unwrap();
        let angle = |link: u32, theta: f64| match link {
            1 => 0.0,
            2 => theta,
            _ => angle_of_rocker(theta),
        };
        let turned = |theta: f64| angle(links[1], theta) - angle(links[0], theta);
        let scene_at = (degrees % 360.0).to_radians();
        let at_scene = within_half_a_turn(turned(scene_at) - f64::to_radians(free));
        let places: Vec<f64> = (0..72).map(|step| f64::from(5 * step).to_radians()).collect();
        let torque = |theta: f64| -5.0 * (at_scene + turned(theta) - turned(scene_at));
        for &theta in &places {
            let found = sweep.at(theta).unwrap()[column].unwrap().value;
            assert!((found - torque(theta)).abs() < 1e-9, "{degrees} {links:?} at {theta}: {found}");
        }
        // The table with bounds has the same numbers.
        sweep.with_bounds().unwrap().run(&places, |theta, values, bounds| {
            let off = (values[column] - torque(theta)).abs();
            assert!(
                off <= bounds[column] + 1e-12,
                "{degrees} {links:?} at {theta}: {off} {}",
                bounds[column]
            );
            assert!(bounds[column] < 1e-9, "{degrees} {links:?} at {theta}: {}", bounds[column]);
        });
    }
}

/// A force along the crank has no moment about its pivot, wherever the crank stands: no size of it balances anything.
#[test]
fn a_sought_force_without_an_arm_leaves_no_balance_of_powers() {
    for degrees in [0.0, 40.0] {
        let scene = crank(
            &format!("\"angle\": {degrees}, \"alpha\": 500,"),
            r#""masses": { "3": { "mass": 2, "at": [80, 0], "inertia": 0.015 }, "4": { "mass": 1.5 } },
            "loads": [ { "name": "Q", "on": 2, "at": "A", "force": "?",
                         "direction": { "from": "O2", "to": "A" } } ], "find": ["load(Q)", "F(1,4)"]"#,
        );
        let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
        let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(agreement.ok(), "{degrees}: {:?} {:?}", agreement.disagreements(), agreement.power);
        assert!(agreement.power.is_none(), "{degrees}: {:?}", agreement.power);
        let readings = &solved.solution.construction.answers;
        let Answer::Indeterminate(why) = &readings[0].answer else { panic!("{:?}", readings[0].answer) };
        let why = why.to_string();
        assert!(why.contains("no arm") && !why.contains("dead centre"), "{why}");
        assert!(matches!(readings[1].answer, Answer::Vector { .. }));
    }
}

/// A pair of scissors of 2 m arms whose foot B is driven to the pivot O: its arm about O vanishes there, and forces grow
/// without end. No number stands where that arm is rounding.
#[test]
fn a_sweep_has_no_force_where_an_arm_is_rounding() {
    let scene = read(
        r#"{ "units": { "length": "m" }, "fixed": { "O": [0, 0] },
        "links": { "3": { "joins": ["B", "A", "P"], "line": [0, 1, 2] }, "4": { "joins": ["O", "A"], "length": 1 } },
        "slides": [ { "pin": "B", "block": 2, "on": { "link": 1, "through": "O", "angle": 0 } } ],
        "near": { "A": [0.7, 0.7], "B": [1.4, 0], "P": [0, 1.4] },
        "input": { "slide": "B", "at": 1.3, "velocity": "-0.2 m/s" },
        "gravity": {}, "masses": { "3": { "mass": 40, "at": "A" } },
        "loads": [ { "name": "W", "on": 3, "at": "P", "force": "1.5 kN", "direction": -90 } ],
        "find": ["F(1,2)", "F(3,4)"] }"#,
    );
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let mut rows = 0;
    sweep.each_position(&sweep.equal_steps(36), |at, values| {
        for value in values.iter().flatten() {
            // 1.9 kN on arms of 2 m at most.
            assert!(value.abs() < 1e5, "at {at}: {value} N");
        }
        rows += 1;
        let open = values.iter().all(Option::is_some);
        assert_eq!(open, at > 1e-9 && at < 2.0 - 1e-9, "at {at}: {values:?}");
    });
    assert!(rows > 30, "{rows}");
}

#[test]
fn a_stiffness_below_zero_is_refused() {
    for stiffness in ["-4", "0"] {
        let text = format!(
            r#"{{ "fixed": {{ "O2": [0, 0] }}, "links": {{ "2": {{ "joins": ["O2", "A"], "length": 1 }} }},
            "input": {{ "link": 2, "angle": 30 }},
            "springs": [ {{ "between": [ {{ "link": 1, "at": [2, 0] }}, {{ "link": 2, "at": "A" }} ],
                           "stiffness": {stiffness}, "free": 1 }} ] }}"#
        );
        let why = refusal(&text);
        assert!(why.contains("a stiffness must be greater than zero"), "{why}");
    }
}

/// 100 + 50 sin θ N m: the level is 50 (1 − cos θ), and changes by 100 J. 0.8 kg m² at 100 rad/s keep the speed to 1.25 %, where
/// 10 % are allowed.
#[test]
fn what_turns_heavily_enough_has_its_own_fluctuation() {
    let scene = read(
        r#"{ "links": {}, "input": { "omega": "100 rad/s" },
        "cycle": { "torque": { "harmonics": { "constant": 100, "sin": [[1, 50]] } },
                   "rotating": [ { "inertia": 0.8 } ], "fluctuation": 0.1 }, "find": ["Ef", "Ks"] }"#,
    );
    let found = answers(&scene);
    near(found["Ef"][0], 100.0);
    near(found["Ks"][0], 100.0 / (0.8 * 1e4));
}

#[test]
fn the_part_of_a_force_stands_after_the_whole_name() {
    let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ],
        "near": { "B": [240, 0] }, "input": { "link": 2, "angle": 30 }, "masses": { "4": { "mass": 1 } },
        "find": ["arm(F(3,4).static,O2)"] }"#;
    let why = refusal(text);
    assert!(why.contains("write arm(F(3,4),O2).static") && !why.contains("parenthesis"), "{why}");
}

/// A torque that is sought on a block which cannot turn balances nothing: of no pair between it and the crank is there a
/// force, whatever equations are left out, and the drawing and the solver say so alike. What hangs on no balance stands.
#[test]
fn a_sought_load_without_work_leaves_no_forces_between_it_and_the_input() {
    let scene = crank(
        r#""angle": 121,"#,
        r#""masses": { "4": { "mass": 1.5 } },
        "loads": [ { "name": "R", "on": 4, "torque": "?" }, { "on": 2, "torque": "10.6 N*m" },
                   { "on": 4, "at": "B", "force": [-400, 0] } ],
        "find": ["load(R)", "F(2,3)", "F(1,2)", "F(4,1)", "Fin(4)"]"#,
    );
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let reckoned = solve_analytically(&scene);
    let agreement = check::agreement(&scene, &solved, &reckoned);
    assert!(agreement.ok(), "{:?} {:?}", agreement.disagreements(), agreement.power);
    let reckoned = reckoned.unwrap();
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
        let refused = |answer: &Answer| matches!(answer, Answer::Indeterminate(_));
        let wanted = asked.name != "Fin(4)";
        assert_eq!(refused(&reading.answer), wanted, "{}: {:?}", asked.name, reading.answer);
        assert_eq!(refused(&reckoned.answer(&asked.quantity)), wanted, "{}", asked.name);
    }
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let of_pairs: Vec<bool> = sweep.columns.iter().map(|column| column.name().starts_with("F(")).collect();
    sweep.each_position(&sweep.equal_steps(12), |at, values| {
        let open = |(value, of_pair): (&Option<f64>, &bool)| !of_pair || value.is_none();
        assert!(values.iter().zip(&of_pairs).all(open), "at {at}: {values:?}");
    });
}

/// Forces of a dyad that hangs on no link out of balance are what they are whoever drives: the rod 5 of a six-bar carries
/// the load of its slider, F = P / cos φ, though the torque that is sought on the block 7 does no work.
#[test]
fn forces_beyond_links_out_of_balance_stand() {
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [150, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 },
                   "4": { "joins": ["O4", "B"], "length": 90 }, "5": { "joins": ["B", "C"], "length": 200 } },
        "slides": [ { "pin": "C", "block": 6, "on": { "link": 1, "through": [0, 60] } } ],
        "near": { "B": [140, 90], "C": [330, 60] }, "input": { "link": 2, "angle": 70, "omega": "10 rad/s" },
        "loads": [ { "name": "R", "on": 4, "at": "O4", "force": "?", "direction": 30 },
                   { "on": 6, "at": "C", "force": [-300, 0] } ],
        "find": ["load(R)", "F(5,6)", "F(3,4)", "x(B)", "x(C)"] }"#,
    );
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{:?} {:?}", agreement.disagreements(), agreement.power);
    let answers: Vec<&Answer> =
        solved.solution.construction.answers.iter().map(|reading| &reading.answer).collect();
    let [Answer::Indeterminate(_), Answer::Vector { value: force, .. }, Answer::Indeterminate(_), b, c] =
        answers[..]
    else {
        panic!("{answers:?}")
    };
    let (Answer::Vector { value: b, .. }, Answer::Vector { value: c, .. }) = (b, c) else { panic!() };
    // The rod pushes the slider along itself; along the guide that is the load.
    let slope = (c[1] - b[1]) / (c[0] - b[0]);
    assert!((force[0] - 300.0).abs() < 1e-9 && (force[1] - 300.0 * slope).abs() < 1e-9, "{force:?}");
}

/// A yoke of one joint has its mass there, if the scene says no other place, whatever loads have own coordinates on it:
/// T ω = −m a v − P v, with x = r cos θ.
#[test]
fn a_mass_stands_at_the_only_joint_beside_loads_in_own_coordinates() {
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "4": { "joins": ["Y"] } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "Y", "angle": 90 } },
                    { "link": 4, "on": { "link": 1, "through": [0, 0] } } ],
        "near": { "A": [42, 42], "Y": [42, 0] }, "input": { "link": 2, "angle": 45, "omega": 10 },
        "masses": { "4": { "mass": 2 } }, "loads": [ { "on": 4, "at": [20, 5], "force": [-50, 0] } ],
        "find": ["T(2)"] }"#,
    );
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let sine = libm::sqrt(0.5);
    let (speed, acceleration) = (-0.06 * 10.0 * sine, -0.06 * 100.0 * sine);
    let torque = (2.0 * acceleration + 50.0) * speed / 10.0;
    let Answer::Scalar { value, .. } = solved.solution.construction.answers[0].answer else { panic!() };
    assert!((value - torque).abs() < 1e-12, "{value} {torque}");
}

/// A torsion spring between the frame and a crank that goes round is wound up by every turn: there is no closed cycle. One
/// on the rocker is wound up as before.
#[test]
fn a_spring_that_is_wound_up_by_every_turn_leaves_no_cycle() {
    let cycle = |link: u32| {
        read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [150, -20] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 40 }}, "3": {{ "joins": ["A", "B"], "length": 140 }},
                       "4": {{ "joins": ["O4", "B"], "length": 90 }} }},
            "near": {{ "B": [140, 70] }}, "input": {{ "link": 2, "angle": 100, "omega": "5 rad/s" }},
            "springs": [ {{ "name": "K", "links": [1, {link}], "stiffness": 5, "free": 80 }} ],
            "loads": [ {{ "on": 4, "torque": "9 N*m", "direction": "against" }} ],
            "find": ["Tmean", "Ef"], "cycle": {{ "load": {{ "of": 2 }} }} }}"#
        ))
    };
    for (link, closes) in [(2, false), (3, true), (4, true)] {
        let scene = cycle(link);
        match solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene) {
            Err(why) => assert!(!closes && why.to_string().contains("no closed cycle"), "{link}: {why}"),
            Ok(solved) => {
                let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
                assert!(closes && agreement.ok(), "{link}: {:?}", agreement.disagreements());
            }
        }
        if !closes {
            let state = solve_analytically(&scene).unwrap();
            let answer = state.answer(&scene.mechanism.asked[0].quantity);
            assert!(matches!(answer, Answer::Indeterminate(_)), "{answer:?}");
        }
    }
}

/// The distance of a force that is zero: it has no line, and nothing is a dead centre.
#[test]
fn a_force_that_is_zero_within_its_error_has_no_line() {
    let scene = crank(
        r#""angle": 70,"#,
        r#""loads": [ { "on": 2, "torque": "0.1 N*m" }, { "on": 4, "at": "B", "force": [0, -7] },
                     { "on": 3, "torque": 0 } ],
        "find": ["arm(F(3,4),O2)", "F(3,4)", "T(2)"]"#,
    );
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let Answer::Indeterminate(why) = &solved.solution.construction.answers[0].answer else { panic!() };
    assert!(why.to_string().contains("has no line"), "{why}");
}

/// A load against the motion turns round with the rocker, and with it the force in the rod: 570 N or more all the way round,
/// it is never drawn through zero where it leaps.
#[test]
fn a_force_that_leaps_is_not_drawn_in_between() {
    use kurbo::{ParamCurve, Point, Vec2};
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [200, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 190 },
                   "4": { "joins": ["O4", "B"], "length": 110 } },
        "near": { "B": [170, 100] }, "input": { "link": 2, "angle": 60, "omega": "20 rad/s cw" },
        "loads": [ { "name": "M", "on": 4, "torque": "60 N*m", "direction": "against" } ], "find": ["F(3,4)"] }"#,
    );
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    let columns: Vec<usize> =
        (0..sweep.columns.len()).filter(|index| sweep.columns[*index].name().starts_with("F(3,4)")).collect();
    let [x, y] = columns[..] else { panic!("{columns:?}") };
    let track = |_: f64, values: &[Option<linkgram::board::Dual>]| {
        let (x, y) = (values[x]?, values[y]?);
        Some((Point::new(x.value, y.value), Vec2::new(x.slope, y.slope)))
    };
    // The torque is F times the distance of the rod from O4, no more than the rocker's length.
    let least = 60.0 / 0.11 - 1.0;
    let mut drawn = 0;
    for (stretch, table) in sweep.stretches.iter().map(|stretch| (stretch, sweep.table(stretch))) {
        let path = table.strokes(&columns, [stretch.from, stretch.to], &track);
        for segment in path.segments() {
            for part in [0.0, 0.25, 0.5, 0.75, 1.0] {
                let at = segment.eval(part);
                assert!(at.to_vec2().hypot() > least, "{at:?}");
                drawn += 1;
            }
        }
    }
    assert!(drawn > 1000, "{drawn}");
}
