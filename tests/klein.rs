//! Klein's construction against the closed form of the slider-crank, the polygons and the analytic solver.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common::{norm, read};
use linkgram::check::{Agreement, agreement};
use linkgram::mechanism::quantity::{Answer, DiagramKind, Indeterminate};
use linkgram::plan::Extent;
use linkgram::sheet::scale;
use linkgram::solve::{SolveError, Solved, solve, solve_analytically};

/// A slider-crank on a guide at this angle and offset; lengths in metres, rates in rad/s and rad/s².
#[derive(Clone, Copy)]
struct Engine {
    crank: f64,
    rod: f64,
    offset: f64,
    guide: f64,
    angle: f64,
    omega: f64,
    alpha: f64,
}

const ENGINE: Engine =
    Engine { crank: 0.05, rod: 0.16, offset: 0.0, guide: 0.0, angle: 50.0, omega: 30.0, alpha: 0.0 };

const ASKED: [&str; 8] = ["v(B)", "v(B/A)", "omega(3)", "a(B)", "a(B/A)", "alpha(3)", "v(A)", "a(A)"];

impl Engine {
    fn scene(&self, asked: &[&str]) -> String {
        let find: Vec<String> =
            asked.iter().map(|name| format!(r#"{{"name": "{name}", "method": "klein"}}"#)).collect();
        let (angle, guide) = (self.angle.to_radians(), self.guide.to_radians());
        // The slider ahead of the crank pin, as the closed form below has it.
        let across = self.offset - self.crank * libm::sin(angle - guide);
        let x = self.crank * libm::cos(angle - guide) + libm::sqrt(self.rod * self.rod - across * across);
        let near = [
            x * libm::cos(guide) - self.offset * libm::sin(guide),
            x * libm::sin(guide) + self.offset * libm::cos(guide),
        ];
        format!(
            r#"{{"fixed": {{"O2": [0, 0]}},
            "links": {{"2": {{"joins": ["O2", "A"], "length": {}}}, "3": {{"joins": ["A", "B"], "length": {}}}}},
            "slides": [{{"pin": "B", "block": 4, "on": {{"link": 1, "through": [0, 0], "angle": {}, "offset": {}}}}}],
            "near": {{"B": [{}, {}]}},
            "input": {{"link": 2, "angle": {}, "omega": {}, "alpha": {}}}, "find": [{}]}}"#,
            self.crank,
            self.rod,
            self.guide,
            self.offset,
            near[0],
            near[1],
            self.angle,
            self.omega,
            self.alpha,
            find.join(", ")
        )
    }

    /// ω₃, ε₃, V_B and A_B along the guide, by differentiating x = r cos θ + √(l² − (e − r sin θ)²) twice.
    fn closed_form(&self) -> [f64; 4] {
        let theta = (self.angle - self.guide).to_radians();
        let (sin, cos) = (libm::sin(theta), libm::cos(theta));
        let sin_phi = (self.offset - self.crank * sin) / self.rod;
        let cos_phi = libm::sqrt(1.0 - sin_phi * sin_phi);
        let omega = -self.crank * cos * self.omega / (self.rod * cos_phi);
        let alpha = (self.crank * (sin * self.omega * self.omega - cos * self.alpha)
            + self.rod * sin_phi * omega * omega)
            / (self.rod * cos_phi);
        let v = -self.crank * sin * self.omega - self.rod * sin_phi * omega;
        let a = -self.crank * (cos * self.omega * self.omega + sin * self.alpha)
            - self.rod * (cos_phi * omega * omega + sin_phi * alpha);
        [omega, alpha, v, a]
    }
}

fn drawn(text: &str) -> (Solved, Agreement) {
    let scene = read(text);
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let agreement = agreement(&scene, &solved, &solve_analytically(&scene));
    (solved, agreement)
}

fn value(solved: &Solved, index: usize) -> ([f64; 2], f64) {
    match &solved.solution.construction.answers[index].answer {
        Answer::Scalar { value, bound } => ([*value, 0.0], *bound),
        Answer::Vector { value, bound } => (*value, *bound),
        other => panic!("{index}: {other:?}"),
    }
}

fn agrees_with_closed_form(engine: Engine) {
    let (solved, agreement) = drawn(&engine.scene(&ASKED));
    assert!(agreement.ok(), "{:?}", agreement.compared);
    assert!(agreement.compared.iter().all(|c| c.difference.is_some()));
    let [omega, alpha, v, a] = engine.closed_form();
    let (sin, cos) = libm::sincos(engine.guide.to_radians());
    for (index, expected) in
        [(0, [v * cos, v * sin]), (2, [omega, 0.0]), (3, [a * cos, a * sin]), (5, [alpha, 0.0])]
    {
        let (got, bound) = value(&solved, index);
        let miss = libm::hypot(got[0] - expected[0], got[1] - expected[1]);
        let size = norm(expected).max(engine.omega.abs() * engine.crank);
        assert!(miss <= bound + 1e-12 * size, "{}: {got:?}, closed form {expected:?}", ASKED[index]);
    }
}

#[test]
fn central_and_offset_engines_all_round() {
    for offset in [0.0, -0.025, 0.03] {
        for guide in [0.0, 37.0] {
            for turn in 0..24 {
                let angle = f64::from(turn) * 15.0;
                agrees_with_closed_form(Engine { offset, guide, angle, ..ENGINE });
            }
        }
    }
}

#[test]
fn a_clockwise_crank_that_gathers_speed() {
    for (omega, alpha) in [(-30.0, 0.0), (30.0, 400.0), (-30.0, 400.0), (25.0, -900.0)] {
        for turn in 0..12 {
            agrees_with_closed_form(Engine {
                offset: 0.02,
                angle: f64::from(turn) * 30.0 + 7.0,
                omega,
                alpha,
                ..ENGINE
            });
        }
    }
}

/// Where the rod turns faster than the crank, ab is longer than AB and the circles do not meet.
#[test]
fn a_rod_that_turns_faster_than_the_crank() {
    for angle in [5.0, 11.0, 20.0] {
        agrees_with_closed_form(Engine { crank: 0.1, rod: 0.06, angle, alpha: 50.0, ..ENGINE });
    }
    // Equal lengths: the rod turns as fast as the crank, and the circles touch.
    for angle in [20.0, 45.0, 70.0] {
        agrees_with_closed_form(Engine { crank: 0.1, rod: 0.1, angle, ..ENGINE });
    }
}

/// At both dead centres of the slider and with the crank square to the guide the construction degenerates to
/// points, and still holds.
#[test]
fn where_images_shrink_to_points() {
    for angle in [0.0, 90.0, 180.0, 270.0] {
        agrees_with_closed_form(Engine { angle, ..ENGINE });
    }
}

/// With the rod square to the guide the crank can go no further: V_B is not determined.
#[test]
fn a_rod_square_to_its_guide_is_a_dead_centre() {
    let engine = Engine { crank: 0.1, rod: 0.05, angle: 30.0, ..ENGINE };
    let scene = read(&engine.scene(&["v(B)", "omega(3)"]));
    let error = solve(&scene, Extent::Asked, scale::for_scene).unwrap_err();
    assert!(matches!(error, SolveError::Indeterminate { .. }), "{error}");
}

#[test]
fn what_is_no_slider_crank_is_refused_by_name() {
    let four_bar = r#"{"fixed": {"O2": [0, 0], "O4": [0.11, 0]},
        "links": {"2": {"joins": ["O2", "A"], "length": 0.04}, "3": {"joins": ["A", "B"], "length": 0.12},
                  "4": {"joins": ["O4", "B"], "length": 0.08}},
        "near": {"B": [0.125, 0.08]}, "input": {"link": 2, "angle": 60, "omega": 10},
        "find": ["v(A)", {"name": "v(B)", "method": "klein"}]}"#;
    let (solved, agreement) = drawn(four_bar);
    let Answer::Indeterminate(Indeterminate::Undefined { why }) =
        &solved.solution.construction.answers[1].answer
    else {
        panic!("{:?}", solved.solution.construction.answers)
    };
    assert!(why.contains("slider-crank"), "{why}");
    assert!(agreement.ok(), "a refusal is no disagreement");
}

#[test]
fn a_crank_at_rest_has_no_scale() {
    let engine = Engine { omega: 0.0, alpha: 10.0, ..ENGINE };
    let scene = read(&engine.scene(&["v(B)", "a(B)"]));
    let error = solve(&scene, Extent::Asked, scale::for_scene).unwrap_err();
    assert!(error.to_string().contains("a crank that turns"), "{error}");
}

/// Velocities alone draw no acceleration part, and neither draws a polygon.
#[test]
fn only_what_is_asked_is_drawn() {
    let acts = |asked: &[&str]| {
        let (solved, _) = drawn(&ENGINE.scene(asked));
        let construction = &solved.solution.construction;
        assert!(
            construction.diagram(DiagramKind::Velocity).is_none()
                && construction.diagram(DiagramKind::Acceleration).is_none()
        );
        construction.auxiliary[0].strokes.len()
    };
    assert!(acts(&["v(B)"]) < acts(&["v(B)", "a(B)"]));
}
