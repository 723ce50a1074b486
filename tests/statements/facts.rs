//! Facts that a scene states twice, and what it states otherwise than it can hold.

use linkgram::check::agreement;
use linkgram::plan::Extent;
use linkgram::sheet::scale;
use linkgram::solve::{solve, solve_analytically};
use linkgram::sweep::Sweep;
use linkgram::{report, scene};

/// A planetary train whose arm has a length of its own, in millimetres.
fn train(arm: &str) -> String {
    format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O"] }}, "3": {{ "joins": ["A"] }}, "4": {{ "joins": ["O", "A"], "length": {arm} }} }},
        "rolls": [{{ "links": [2, 3], "centres": ["O", "A"], "teeth": [20, 40], "module": 5 }}],
        "inputs": [{{ "link": 2, "omega": 10 }}, {{ "link": 4, "angle": 30, "omega": -4, "alpha": 3 }}],
        "find": ["omega(3)", "alpha(3)", "v(A)", "a(A)", "I(2,3)", "I(1,3)"] }}"#
    )
}

/// ω3 = ω4 + (ω4 − ω2) z2/z3.
#[test]
fn radii_and_the_length_of_an_arm_are_one_fact() {
    for arm in ["150", "150.00000000000003", "150.0000001", "149.9999"] {
        let scene = scene::read(&train(arm), "train.json").unwrap();
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        let found = agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(found.ok(), "{arm}: {:e}", found.worst_ratio());
        let omega = solved.answer(&scene, "omega(3)").unwrap();
        let linkgram::mechanism::quantity::Answer::Scalar { value, bound } = omega else {
            panic!("{omega:?}")
        };
        assert!((value + 11.0).abs() <= *bound, "{arm}: {value} within {bound:e}");
    }
    let told = scene::read(&train("149"), "train.json").unwrap_err().to_string();
    let both = told.contains("150 mm") && told.contains("149 mm") && told.contains("rolls[0]");
    assert!(both, "{told}");
}

/// A rod through a swivelling guide that stands by places.
const CYLINDER: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
    "placed": { "A": [30, 40], "E": [65, 20] },
    "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "E"] }, "4": { "joins": ["O4"] } },
    "slides": [{ "link": 3, "on": { "link": 4, "through": "O4" } }],
    "input": { "link": 2, "omega": 10 }, "find": ["x(E)", "omega(4)"] }"#;

/// On the way the rod passes O4: tan θ4 = (A − O4), and E lies √1625 beyond A toward O4.
#[test]
fn what_rides_as_placed_is_swept() {
    let scene = scene::read(CYLINDER, "cylinder.json").unwrap();
    let sweep = Sweep::new(&scene.mechanism, None).unwrap();
    for turn in [0.2, 1.0, 2.5, 4.0] {
        let at = sweep.start + turn;
        let row = sweep.at(at).unwrap();
        let (sin, cos) = libm::sincos(at);
        let a = [0.05 * cos, 0.05 * sin];
        let (dx, dy) = (0.1 - a[0], -a[1]);
        let (l, r) = (libm::hypot(dx, dy), libm::hypot(0.035, 0.02));
        for (column, found) in sweep.columns.iter().zip(&row) {
            let (Some(axis), "x(E)", Some(found)) = (column.axis, column.asked.name.as_str(), found) else {
                continue;
            };
            let truth = a[axis] + [dx, dy][axis] * r / l;
            assert!((found.value - truth).abs() < 1e-12, "{at}: {} is not {truth}", found.value);
        }
    }
}

/// The rod's end is 60 mm from A toward O4, or beyond A; the guide says which.
#[test]
fn a_rough_place_that_does_not_hold_is_noted() {
    let text = |near: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [120, 10] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 40 }}, "3": {{ "joins": ["A", "E"], "length": 70 }},
                        "4": {{ "joins": ["O4"] }} }},
            "slides": [{{ "link": 3, "on": {{ "link": 4, "through": "O4" }} }}], "near": {{ "E": {near} }},
            "input": {{ "link": 2, "angle": 50, "omega": 10 }}, "find": ["v(E)"] }}"#
        )
    };
    for (near, notes) in [("[-43, 46]", 0), ("[94, 16]", 1)] {
        let scene = scene::read(&text(near), "cylinder.json").unwrap();
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        let told = report::unheld_hints(&scene, &solved.solution.construction);
        assert_eq!(told.len(), notes, "{near}: {told:?}");
    }
}

#[test]
fn the_number_of_a_block_in_quotes_is_told() {
    let text = r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 2 } },
        "slides": [{ "pin": "A", "block": 4, "on": { "link": 1, "through": [0, 1] } }],
        "near": { "A": [1, 1] }, "input": { "slide": "4", "at": 1, "velocity": 1 } }"#;
    let told = scene::read(text, "slide.json").unwrap_err().to_string();
    assert!(told.contains("without quotes"), "{told}");
}
