//! What is told next to dead centres and change points, and of what places leave open: right digits or a refusal, never a
//! zero that is none. Truth is closed here: the rates of a parallelogram, and what stands square to its link.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::mechanism::quantity::{Answer, Quantity};
use linkgram::scene;
use linkgram::solve::{Settings, solve_numbers};
use serde_json::{Value, json};

use crate::cli::run_in;
use crate::common::root;

fn parallelogram(angle: f64) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "links": {
            "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 100 },
            "4": { "joins": ["O4", "B"], "length": 40 }
        },
        "near": { "B": [100.0 + 40.0 * angle.to_radians().cos(), 40.0 * angle.to_radians().sin()] },
        "input": { "link": 2, "angle": angle, "omega": "5 rad/s ccw" },
        "find": ["v(B)", "omega(3)", "omega(4)", "a(B)", "alpha(3)", "alpha(4)", "alpha(4/3)", "omega(3/1)"]
    })
}

/// ω₃ = 0, ω₄ = ω₂, v(B) = 200 mm/s, a(B) = 1000 mm/s², α = 0: as far as it is answered, to 3 digits of what is large.
#[test]
fn next_to_a_change_point_every_number_is_right_or_refused() {
    let mut answered = 0;
    let mut refused = 0;
    for exponent in -9..2 {
        for side in [1.0, -1.0] {
            let scene = parallelogram(side * libm::pow(10.0, f64::from(exponent)));
            let scene = scene::read(&scene.to_string(), "scene.json").unwrap();
            let solved = match solve_numbers(&scene, Settings::default()) {
                Ok(solved) => solved,
                Err(_) => {
                    refused += 1;
                    continue;
                }
            };
            for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
                let (own, right, large) = match (asked.quantity, &reading.answer) {
                    (_, Answer::Indeterminate(_)) => continue,
                    (Quantity::Omega(link), Answer::Scalar { value, .. }) => {
                        (*value, if link.0 == 3 { 5.0 } else { 0.0 }, 5.0)
                    }
                    (Quantity::RelativeOmega(..), Answer::Scalar { value, .. }) => (*value, 0.0, 5.0),
                    (Quantity::Alpha(_) | Quantity::RelativeAlpha(..), Answer::Scalar { value, .. }) => {
                        (*value, 0.0, 25.0)
                    }
                    (Quantity::Velocity(_), Answer::Vector { value, .. }) => {
                        (libm::hypot(value[0], value[1]), 0.2, 0.2)
                    }
                    (_, Answer::Vector { value, .. }) => (libm::hypot(value[0], value[1]), 1.0, 1.0),
                    (_, other) => panic!("{}: {other:?}", asked.name),
                };
                answered += 1;
                assert!((own - right).abs() <= 1e-3 * large, "{exponent}: {} is {own}", asked.name);
            }
        }
    }
    assert!(answered > 40 && refused > 4, "{answered} answered, {refused} refused");
}

/// The table that `solve` prints.
fn table(scene: &Value) -> String {
    let ran = run_in(root(), &["solve", "-"], Some(scene.to_string().as_bytes()));
    assert!(ran.code == 0, "{}", ran.err);
    ran.out
}

/// A coordinate that rounding leaves is zero; one that is smaller than the room of its place is the stated one.
#[test]
fn coordinates_are_told_as_they_are_known() {
    // A crank of 50 from (30, 40) towards the origin.
    let angle = libm::atan2(-40.0, -30.0).to_degrees();
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [30, 40] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 } },
        "input": { "link": 2, "angle": angle, "omega": "1 rad/s" }, "find": ["x(A)"]
    });
    assert!(table(&scene).contains("x(A)      (0, 0) mm"), "{}", table(&scene));
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [90, 0] },
        "placed": { "A": [30, 40], "B": { "at": [48, 0.3], "within": "1 mm" } },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] } },
        "input": { "link": 2, "omega": "20 rad/s ccw" }, "find": ["x(B)"]
    });
    let told = table(&scene);
    assert!(told.contains("(48.0 ± ") && told.contains(", 0.3 ± "), "{told}");
    let scene = scene::read(&scene.to_string(), "scene.json").unwrap();
    let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default()).unwrap();
    assert!(format!("{drawn:?}").contains("0.3"), "the sheet tells another y of B");
}

/// A turning vector stands square to its link in the table as well: what a room leaves open has no direction of its own.
#[test]
fn directions_of_roomy_places_are_those_of_the_drawing() {
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [90, 0] },
        "placed": { "A": [30, 40], "B": { "at": [48, 49], "within": "1 mm" } },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] } },
        "input": { "link": 2, "omega": "20 rad/s ccw" }, "find": ["at(B/A)", "v(B)"]
    });
    let told = table(&scene);
    let direction = |name: &str| -> f64 {
        let row = told.lines().find(|line| line.starts_with(name)).unwrap();
        let words: Vec<&str> = row.split_whitespace().collect();
        words[words.iter().position(|word| *word == "deg").unwrap() - 1].parse().unwrap()
    };
    // AB = (18, 9), O4B = (−42, 49).
    for (name, along) in [("at(B/A)", [18.0_f64, 9.0]), ("v(B)", [-42.0, 49.0])] {
        let own = direction(name).to_radians();
        let slant = (own.cos() * along[0] + own.sin() * along[1]) / along[0].hypot(along[1]);
        // Three figures of the angle are told.
        assert!(slant.abs() < 0.01, "{told}");
    }
    assert!(told.contains(" ± "), "{told}");
}

/// A sheet says nothing of points that coincide where the rooms of places only allow it.
#[test]
fn what_a_room_allows_to_be_zero_is_not_told_as_zero() {
    // Links of 50, rocker and coupler nearly as in a parallelogram: ω₃ is small and no zero.
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "placed": { "A": [30, 40], "B": { "at": [130, 40.2], "within": "0.5 mm" } },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] } },
        "input": { "link": 2, "omega": "2 rad/s ccw" }, "find": ["omega(3)", "v(B/A)"]
    });
    let scene = scene::read(&scene.to_string(), "scene.json").unwrap();
    let solved = solve_numbers(&scene, Settings::default()).unwrap();
    // V_A = 2 (−40, 30). V_B stands square to (30, 40.2), V_BA to (100, 0.2): V_A + ω₃ (−0.2, 100) = ω₄ (−40.2, 30).
    let [ax, ay, bx, by, cx, cy] = [-80.0, 60.0, -0.2, 100.0, -40.2, 30.0];
    let omega = (cx * ay - cy * ax) / (cy * bx - cx * by);
    let reading = &solved.solution.construction.answers[0];
    let Answer::Scalar { value, bound } = reading.answer else { panic!("{reading:?}") };
    assert!((value - omega).abs() < 1e-12 && bound > value.abs(), "{value} ± {bound}, {omega}");
    assert!(!reading.zero);
    let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default()).unwrap();
    let text = format!("{drawn:?}");
    assert!(!text.contains("is zero") && !text.contains("coincide"));
}
