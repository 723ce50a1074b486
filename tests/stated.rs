//! Places by what a figure states, and places with room: both solvers find them by themselves.
//!
//! The truth of each is a closed form computed here, stated once more as `placed` with all its digits.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use crate::common;

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{Refusal, Scene};
use linkgram::solve::{SolveError, solve, solve_analytically};
use linkgram::{report, sheet};

/// An answer in SI units with its bound.
type Number = (Vec<f64>, f64);

fn number(name: &str, answer: &Answer) -> Number {
    match answer {
        Answer::Scalar { value, bound } => (vec![*value], *bound),
        Answer::Vector { value, bound } => (value.to_vec(), *bound),
        other => panic!("{name} is {other:?}"),
    }
}

fn apart(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt()
}

/// The answers of a scene by both solvers, which agree within their bounds.
fn answers(scene: &Scene) -> Vec<(String, Number)> {
    let solved = solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{}", report::diagnose(scene, &error)));
    let state = solve_analytically(scene).unwrap_or_else(|error| panic!("{error}"));
    let asked = scene.mechanism.asked.iter().zip(&solved.solution.construction.answers);
    asked
        .map(|(asked, reading)| {
            let drawn = number(&asked.name, &reading.answer);
            let other = number(&asked.name, &state.answer(&asked.quantity));
            let difference = apart(&drawn.0, &other.0);
            assert!(difference <= drawn.1 + other.1, "{}: {drawn:?} and {other:?}", asked.name);
            (asked.name.clone(), drawn)
        })
        .collect()
}

/// That a scene has the answers of another one, within the bounds of both.
fn same(stated: &str, truth: &str) {
    let (stated_answers, truth) = (answers(&common::read(stated)), answers(&common::read(truth)));
    assert!(stated_answers.len() > 5 && stated_answers.len() == truth.len());
    for ((name, one), (other_name, other)) in stated_answers.iter().zip(&truth) {
        assert_eq!(name, other_name);
        // What the digits of the truth leave open is in the bounds.
        let allowed = one.1 + other.1 + 1e-15 * other.0.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
        assert!(apart(&one.0, &other.0) <= allowed, "{name}: {one:?}, not {other:?}\n{stated}");
        assert!(
            one.1 <= 1e-9 * (1.0 + other.0.iter().fold(0.0_f64, |m, x| m.max(x.abs()))),
            "{name}: {one:?}"
        );
    }
}

/// A four-bar O2 (0,0), O4 (9,0) with crank 2, coupler 3 and rocker 4 without dimensions.
fn four_bar(places: &str) -> String {
    format!(
        r#"{{ "fixed": {{ "O2": [0, 0], "O4": [9, 0] }}, {places},
        "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"] }},
                    "4": {{ "joins": ["O4", "B"] }} }},
        "input": {{ "link": 2, "omega": 2, "alpha": 1 }} }}"#
    )
}

fn placed(a: [f64; 2], b: [f64; 2]) -> String {
    four_bar(&format!(r#""placed": {{ "A": {a:?}, "B": {b:?} }}"#))
}

fn stated(a: &str, b: &str, near: &str) -> String {
    four_bar(&format!(r#""where": {{ "A": {a}, "B": {b} }}, "near": {{ {near} }}"#))
}

const A: &str = r#"[{ "from": "O2", "distance": 5, "direction": 50 }]"#;

fn a() -> [f64; 2] {
    let (sin, cos) = 50.0_f64.to_radians().sin_cos();
    [5.0 * cos, 5.0 * sin]
}

#[test]
fn a_ray_with_a_distance_is_the_point() {
    let (sin, cos) = 80.0_f64.to_radians().sin_cos();
    let b = [9.0 + 6.0 * cos, 6.0 * sin];
    same(&stated(A, r#"{ "direction": 80, "distance": 6, "from": "O4" }"#, ""), &placed(a(), b));
}

#[test]
fn two_circles() {
    // About O2 and O4, nine apart: x = (r² − s² + 81) / 18.
    let x = (121.0 - 36.0 + 81.0) / 18.0;
    let y = (121.0_f64 - x * x).sqrt();
    let loci = r#"[{ "from": "O2", "distance": 11 }, { "from": "O4", "distance": 6 }]"#;
    same(&stated(A, loci, r#""B": [10, 5]"#), &placed(a(), [x, y]));
    same(&stated(A, loci, r#""B": [10, -5]"#), &placed(a(), [x, -y]));
}

#[test]
fn a_ray_and_a_circle() {
    // From A at 10°; about O4: the far meet is the only one ahead.
    let (sin, cos) = 10.0_f64.to_radians().sin_cos();
    let [dx, dy] = [a()[0] - 9.0, a()[1]];
    let along = dx * cos + dy * sin;
    let reach = -along + (along * along - (dx * dx + dy * dy - 64.0)).sqrt();
    let b = [a()[0] + reach * cos, a()[1] + reach * sin];
    let loci = r#"[{ "from": "O4", "distance": 8 }, { "from": "A", "direction": 10 }]"#;
    same(&stated(A, loci, ""), &placed(a(), b));
}

#[test]
fn a_line_square_to_another() {
    // Through A square to O2A, down to the line y = 1.
    let [x, y] = a();
    let b = [x - (1.0 - y) * y / x, 1.0];
    let on = r#"{ "on": { "link": 1, "through": [0, 1], "angle": 0 } }"#;
    same(&stated(A, &format!(r#"[{{ "from": "A", "square_to": ["O2", "A"] }}, {on}]"#), ""), &placed(a(), b));
    // The same line, turned and shifted into its place.
    let on = r#"{ "on": { "link": 1, "through": "O2", "toward": "O4", "turned": "180 deg", "offset": -1 } }"#;
    same(&stated(A, &format!(r#"[{on}, {{ "from": "A", "square_to": ["A", "O2"] }}]"#), ""), &placed(a(), b));
}

#[test]
fn seen_at_a_right_angle() {
    // On the circle over O2O4, at the distance 7 of O2.
    let x = 49.0 / 9.0;
    let y = (49.0_f64 - x * x).sqrt();
    for at in ["90", "\"90 cw\"", "-90", "\"0.25 rev\""] {
        let loci = format!(r#"[{{ "sees": ["O2", "O4"], "at": {at} }}, {{ "from": "O2", "distance": 7 }}]"#);
        same(&stated(A, &loci, r#""B": [5, 4]"#), &placed(a(), [x, y]));
        same(&stated(A, &loci, r#""B": [5, -4]"#), &placed(a(), [x, -y]));
    }
}

#[test]
fn seen_at_another_angle() {
    // ∠O2 B O4 = 40° from the left of O2O4: by the law of sines, with 65° at O4.
    let [at, o4] = [40.0_f64, 65.0].map(f64::to_radians);
    let from_o4 = 9.0 * (std::f64::consts::PI - at - o4).sin() / at.sin();
    let b = [9.0 - from_o4 * o4.cos(), from_o4 * o4.sin()];
    let ray = r#"{ "from": "O4", "direction": 115 }"#;
    same(&stated(A, &format!(r#"[{{ "sees": ["O2", "O4"], "at": 40 }}, {ray}]"#), ""), &placed(a(), b));
    // Clockwise it is the arc on the other side.
    let ray = r#"{ "from": "O4", "direction": -115 }"#;
    let loci = format!(r#"[{ray}, {{ "sees": ["O4", "O2"], "at": 40 }}]"#);
    same(&stated(A, &loci, ""), &placed(a(), [b[0], -b[1]]));
    let loci = format!(r#"[{ray}, {{ "sees": ["O2", "O4"], "at": "40 deg cw" }}]"#);
    same(&stated(A, &loci, ""), &placed(a(), [b[0], -b[1]]));
    // Obtuse: seen at 140° from the other part of that circle.
    let [at, o4] = [140.0_f64, 15.0].map(f64::to_radians);
    let from_o4 = 9.0 * (std::f64::consts::PI - at - o4).sin() / at.sin();
    let b = [9.0 - from_o4 * o4.cos(), from_o4 * o4.sin()];
    let loci = r#"[{ "from": "O4", "direction": 165 }, { "sees": ["O2", "O4"], "at": 140 }]"#;
    same(&stated(A, loci, ""), &placed(a(), b));
}

#[test]
fn an_arc_and_a_line_of_a_link() {
    // On the arc of 5 about (9, 1), on the line from O4 square up.
    let loci =
        r#"[{ "on": { "link": 1, "centre": [9, 1], "radius": 5 } }, { "from": "O4", "direction": 90 }]"#;
    same(&stated(A, loci, ""), &placed(a(), [9.0, 6.0]));
    // On a line through two points of different links, turned.
    let loci = r#"[{ "on": { "through": "O4", "toward": "A", "turned": -20 } },
                   { "on": { "link": 1, "through": [0, 5] } }]"#;
    let direction = a()[1].atan2(a()[0] - 9.0) - 20.0_f64.to_radians();
    same(&stated(A, loci, ""), &placed(a(), [9.0 + 5.0 / direction.tan(), 5.0]));
    // On the line of the placed crank, prolonged.
    let loci =
        r#"[{ "on": { "link": 2, "through": "O2", "toward": "A" } }, { "from": "O4", "direction": 90 }]"#;
    same(&stated(A, loci, ""), &placed(a(), [9.0, 9.0 * 50.0_f64.to_radians().tan()]));
}

/// Dimensions that say the same, or the same but for rounding: they hold, and both solvers agree.
#[test]
fn dimensions_beside_what_is_stated() {
    let x = (121.0 - 36.0 + 81.0) / 18.0;
    let y = (121.0_f64 - x * x).sqrt();
    let coupler = (x - a()[0]).hypot(y - a()[1]);
    let loci = r#"[{ "from": "O2", "distance": 11 }, { "from": "O4", "distance": 6 }]"#;
    let base = stated(A, loci, r#""B": [10, 5]"#);
    let truth = placed(a(), [x, y]);
    let with = |base: &str, link: &str, length: f64| {
        base.replace(&format!("[{link}] }}"), &format!("[{link}], \"length\": {length:?} }}"))
    };
    let one = with(&base, r#""O4", "B""#, 6.0);
    assert!(one.contains("\"length\""));
    same(&one, &truth);
    let one = with(&base, r#""O2", "A""#, 5.0);
    same(&one, &truth);
    let two = with(&one, r#""O4", "B""#, 6.0);
    same(&two, &truth);
    let three = with(&two, r#""A", "B""#, coupler);
    same(&three, &truth);
    // Within rounding of a figure the dimension holds.
    let rocker = 6.0 * (1.0 + 3e-8);
    let moved = with(&base, r#""O4", "B""#, rocker);
    let b = [9.0 + (x - 9.0) * rocker / 6.0, y * rocker / 6.0];
    same(&moved, &placed(a(), b));
    // By more it is an error that names the point.
    let apart = with(&base, r#""O4", "B""#, 6.001);
    let scene = common::read(&apart);
    let error = solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap_err();
    let told = report::diagnose(&scene, &error).to_string();
    assert!(told.contains("where.B: B is stated 0.001 m beside the circle of 6.001 m about O4"), "{told}");
    let apart = with(&with(&two, r#""A", "B""#, coupler + 0.01), "", 0.0);
    let scene = common::read(&apart);
    let error = solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap_err();
    assert!(report::diagnose(&scene, &error).to_string().contains("where.B: B is stated"), "{error}");
}

/// A point is stated from the end of a crank that stands by its length and angle.
#[test]
fn stated_from_a_driven_crank() {
    let text = |b: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [9, 0] }}, {b},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 5 }}, "3": {{ "joins": ["A", "B"], "length": 7 }},
                        "4": {{ "joins": ["O4", "B"] }} }},
            "input": {{ "link": 2, "angle": 50, "omega": 2 }} }}"#
        )
    };
    // Up the ray from O4, seven from A.
    let (sin, cos) = 80.0_f64.to_radians().sin_cos();
    let [dx, dy] = [9.0 - a()[0], -a()[1]];
    let along = dx * cos + dy * sin;
    let reach = -along + (along * along - (dx * dx + dy * dy - 49.0)).sqrt();
    let b = [9.0 + reach * cos, reach * sin];
    let loci = r#"[{ "from": "O4", "direction": 80 }, { "from": "A", "distance": 7 }]"#;
    let stated = text(&format!(r#""where": {{ "B": {loci} }}, "near": {{ "B": [10, 8] }}"#));
    same(&stated, &text(&format!(r#""placed": {{ "B": {b:?} }}"#)));
}

/// Two segments seen at two angles: the one meet that is no end of them (resection).
#[test]
fn a_resection() {
    let b: [f64; 2] = [6.0, 7.0];
    let angle = |p: [f64; 2], q: [f64; 2]| {
        let turn = (q[1] - b[1]).atan2(q[0] - b[0]) - (p[1] - b[1]).atan2(p[0] - b[0]);
        turn.to_degrees()
    };
    let (first, second) = (angle([0.0, 0.0], [9.0, 0.0]), angle([9.0, 0.0], a()));
    let loci = format!(
        r#"[{{ "sees": ["O2", "O4"], "at": {first:?} }}, {{ "sees": ["O4", "A"], "at": {second:?} }}]"#
    );
    let text = stated(A, &loci, "");
    let found = answers(&common::read(&text.replace("\"input\"", "\"find\": [\"x(B)\"], \"input\"")));
    assert!(apart(&found[0].1.0, &b) < 1e-12, "{found:?}");
}

/// What does not meet, or meets twice, is refused with the names of the points.
#[test]
fn what_does_not_meet() {
    let refused = |a: &str, b: &str, near: &str, refusal: Refusal, part: &str| {
        let scene = common::read(&stated(a, b, near));
        let error: SolveError = solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap_err();
        assert_eq!(error.refusal(), Some(refusal), "{error}");
        let told = report::diagnose(&scene, &error).to_string();
        assert!(told.contains("where.B") && told.contains(part), "{part}: {told}");
        assert!(solve_analytically(&scene).is_err(), "the other solver refuses it as well");
    };
    let circles = r#"[{ "from": "O2", "distance": 2 }, { "from": "O4", "distance": 6 }]"#;
    let apart = "the circle of 2 m about O2 and the circle of 6 m about O4 do not meet";
    refused(A, circles, "", Refusal::CannotAssemble, apart);
    let circles = r#"[{ "from": "O2", "distance": 11 }, { "from": "O4", "distance": 6 }]"#;
    refused(A, circles, "", Refusal::Ambiguous, "\"near\": { \"B\":");
    // Between both.
    refused(A, circles, r#""B": [9, 0]"#, Refusal::Ambiguous, "\"near\": { \"B\":");
    // The line meets the circle, but behind the ray.
    let behind = r#"[{ "from": "O2", "direction": 180 }, { "from": "O4", "distance": 2 }]"#;
    refused(A, behind, "", Refusal::CannotAssemble, "the ray from O2 at 180 deg");
    let touch = r#"[{ "from": "O2", "distance": 3 }, { "from": "O4", "distance": 6 }]"#;
    refused(A, touch, "", Refusal::CannotAssemble, "only touch");
    let blind =
        r#"[{ "sees": ["O2", "O4"], "at": 40 }, { "on": { "link": 1, "through": "O2", "toward": "O4" } }]"#;
    refused(A, blind, "", Refusal::CannotAssemble, "do not meet");
    let beside = r#"[{ "from": "O2", "direction": 30 }, { "from": "O4", "direction": 30 }]"#;
    refused(A, beside, "", Refusal::CannotAssemble, "side by side");
    let same = r#"[{ "from": "O2", "distance": 3 }, { "on": { "link": 1, "centre": "O2", "radius": 4 } }]"#;
    refused(A, same, "", Refusal::CannotAssemble, "do not meet");
}

/// Everything that a scene is for is there for stated places: sheets, questions, sweeps, other positions.
#[test]
fn sheets_tell_what_is_stated() {
    let x = (121.0 - 36.0 + 81.0) / 18.0;
    let loci = r#"[{ "sees": ["O2", "O4"], "at": 50 }, { "from": "O4", "direction": 115 }]"#;
    let a = r#"[{ "from": "O2", "distance": 5 }, { "from": "O2", "direction": 50 }]"#;
    let scene = common::read(&stated(a, loci, ""));
    let solved = solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    assert!(x > 0.0 && solved.left_out.is_none());
    let sweep = linkgram::sweep::Sweep::new(&scene.mechanism, None).unwrap();
    assert!(!sweep.stretches.is_empty());
}

/// The room of a place is in the bound of every answer, and the truth within that room lies within the bound.
#[test]
fn room_enters_every_bound() {
    let (sin, cos) = 80.0_f64.to_radians().sin_cos();
    let b = [9.0 + 6.0 * cos, 6.0 * sin];
    let truth = answers(&common::read(&placed(a(), b)));
    for (dx, dy) in [(0.0, 0.0), (0.03, 0.0), (-0.02, 0.02), (0.0, -0.03)] {
        let read = [b[0] + dx, b[1] + dy];
        let text = four_bar(&format!(
            r#""placed": {{ "A": {:?}, "B": {{ "at": {read:?}, "within": "30.1 mm" }} }}"#,
            a()
        ));
        for (text, held) in
            [(text.clone(), false), (text.replace(r#"["O4", "B"]"#, r#"["O4", "B"], "length": 6"#), true)]
        {
            for ((name, one), (_, other)) in answers(&common::read(&text)).iter().zip(&truth) {
                assert!(apart(&one.0, &other.0) <= one.1, "{name}: {one:?}, not {other:?} ({held})");
                // ω₂ and what depends on the crank alone know nothing of B.
                let of_crank = ["v(A)", "a(A)", "omega(2)", "alpha(2)"].contains(&name.as_str());
                assert_eq!(one.1 < 1e-9, of_crank, "{name}: {one:?}");
            }
        }
    }
}
