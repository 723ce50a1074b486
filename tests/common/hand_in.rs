//! What the tests of a classroom share: one slider-crank with its closed forms, how it is graded, and the terms of an exam.

use linkgram::exam::{Loose, Terms};
use linkgram::grade::{GradeSettings, Report, grade, read_answers};
use linkgram::scene::{self, Scene};
use linkgram::solve::Hand;
use serde_json::Value;

/// Crank 30 cm at 60°, rod 50 cm, 10 rad/s counter-clockwise.
pub(crate) const SLIDER: &str = r#"{
    "title": "Slider-crank", "units": { "length": "cm" },
    "fixed": { "O2": [0, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 30 }, "3": { "joins": ["A", "B"], "length": 50 } },
    "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } }],
    "near": { "B": [58, 0] },
    "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
    "find": ["v(B)", "omega(3)", "a(B)", "alpha(3)"],
    "sheet": { "marks": { "a(B)": 3 } }
}"#;

pub(crate) fn slider() -> Scene {
    scene::read(SLIDER, "slider.json").unwrap()
}

pub(crate) fn graded(scene: &Scene, answers: &Value) -> Report {
    let answers = read_answers(&answers.to_string(), scene).unwrap();
    grade(scene, &answers, &GradeSettings::default()).unwrap()
}

/// The slider-crank by its closed forms, in cm and s.
#[derive(Clone, Copy)]
pub(crate) struct Closed {
    pub(crate) a: [f64; 2],
    pub(crate) b: [f64; 2],
    /// Along the guide, to the right.
    pub(crate) speed: f64,
    pub(crate) omega: f64,
    pub(crate) acceleration: f64,
    pub(crate) alpha: f64,
}

/// The crank of this length at this angle (radians), and V_A so many times too large.
pub(crate) fn closed(crank: f64, angle: f64, enlarged: f64) -> Closed {
    let (rod, rate) = (50.0_f64, 10.0);
    let a = [crank * libm::cos(angle), crank * libm::sin(angle)];
    let d = [(rod * rod - a[1] * a[1]).sqrt(), -a[1]];
    // V_B = V_A + ω₃ × d has no part across the guide, and A_B neither.
    let omega = -enlarged * rate * a[0] / d[0];
    let speed = -enlarged * rate * a[1] - omega * d[1];
    let alpha = (rate * rate * a[1] + omega * omega * d[1]) / d[0];
    let acceleration = -rate * rate * a[0] - omega * omega * d[0] - alpha * d[1];
    Closed { a, b: [a[0] + d[0], 0.0], speed, omega, acceleration, alpha }
}

/// The same as the scene has it.
pub(crate) fn right() -> Closed {
    closed(30.0, 60_f64.to_radians(), 1.0)
}

/// Terms of an exam with the usual hand.
pub(crate) fn terms(variants: usize, seed: u64, loose: Loose) -> Terms {
    let hand = Hand { length: 0.2, angle: 0.3_f64.to_radians() };
    Terms { variants, seed, flattest: 15.0_f64.to_radians(), hand, max_tolerance: 0.1, loose }
}
