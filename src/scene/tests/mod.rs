//! The reader as a whole: what scenes mean, and what bad ones are told.

mod diagnostics;
mod figure;
mod meaning;
mod placed;
mod robust;

use super::{Diagnostic, Scene, read};
use crate::mechanism::{Given, Place};

/// The example of the published format.
const EXAMPLE: &str = r#"{
  "title": "Problem 3-1: four-bar, two-arm rocker, rod and slider",
  "units":  { "length": "cm", "angle": "deg", "time": "s" },
  "fixed":  { "O2": [0, 0], "O4": [45, 15] },
  "links": {
    "2": { "joins": ["O2", "A"], "length": 15 },
    "3": { "joins": ["A", "B"], "length": 45 },
    "4": { "joins": ["O4", "B", "C"], "line": [0, 30, -30] },
    "5": { "joins": ["C", "D"], "length": 37 }
  },
  "slides": [ { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 37], "angle": 0 } } ],
  "near":   { "B": [52, -14], "D": [1, 37] },
  "input":  { "link": 2, "angle": 30, "omega": "10 rad/s cw" },
  "find":   ["v(B)", "v(B/A)", "omega(3)", "omega(4)", "a(D)", "alpha(3)", "rub(B)"],
  "pins":   { "B": { "radius": "5 mm" } },
  "published": { "v(B)": "170 cm/s", "omega(4)": "5.66 rad/s ccw", "alpha(5)": { "value": 16.48, "within": "10 %", "why": "1 mm on the printed drawing" } }
}"#;

/// Reads a scene that must be good.
fn good(text: &str) -> Scene {
    match read(text, "scene.json") {
        Ok(scene) => scene,
        Err(error) => panic!("{error}\n{text}"),
    }
}

/// Reads a scene that must be bad.
fn bad(text: &str) -> Diagnostic {
    match read(text, "scene.json") {
        Ok(_) => panic!("accepted:\n{text}"),
        Err(error) => error,
    }
}

/// The example with one part replaced.
fn example_with(old: &str, new: &str) -> String {
    assert_eq!(EXAMPLE.matches(old).count(), 1, "{old}");
    EXAMPLE.replace(old, new)
}

/// Whether a number is the expected one within its own error and one rounding.
#[track_caller]
fn close(given: Given, expected: f64) {
    let slack = given.error + expected.abs() * f64::EPSILON;
    assert!((given.value - expected).abs() <= slack, "{given:?} is not {expected}");
}

#[track_caller]
fn place(scene: &Scene, name: &str) -> Place {
    scene.mechanism.point(scene.mechanism.point_named(name).unwrap()).place
}
