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

/// What is told of a scene that is not solved.
fn refusal(text: &str) -> String {
    let scene = match scene::read(text, "scene.json") {
        Ok(scene) => scene,
        Err(error) => return error.to_string(),
    };
    let refused = solve(&scene, Extent::Asked, scale::for_scene).map(|_| ()).unwrap_err();
    report::diagnose(&scene, &refused).to_string()
}

/// Nothing rolls, and a place is not what is missing: the slider's input states no angle. With it, the guide lies along
/// that angle, and A where a circle of 2 m about O2 meets the line through O4.
#[test]
fn a_driven_slider_on_a_swivel_needs_the_angle_of_its_input() {
    let text = |angle: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [5, 0] }}, "near": {{ "A": [1, 1.7] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 2 }}, "3": {{ "joins": ["A"] }}, "4": {{ "joins": ["O4"] }} }},
            "slides": [{{ "link": 3, "on": {{ "link": 4, "through": "O4" }} }}],
            "input": {{ "link": 3, {angle} "omega": 10 }}, "find": ["x(A)"] }}"#
        )
    };
    let told = refusal(&text(""));
    assert!(told.contains("link 3 is driven") && told.contains("\"angle\""), "{told}");
    assert!(!told.contains("rolling"), "{told}");
    let scene = scene::read(&text(r#""angle": 160,"#), "scene.json").unwrap();
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
    let linkgram::mechanism::quantity::Answer::Vector { value: [x, y], .. } =
        *solved.answer(&scene, "x(A)").unwrap()
    else {
        panic!("no place")
    };
    let (sin, cos) = libm::sincos(160.0_f64.to_radians());
    assert!((x * x + y * y - 4.0).abs() < 1e-9, "{x} {y}");
    assert!(((x - 5.0) * sin - y * cos).abs() < 1e-9, "{x} {y}");
}

/// A link is no block: it cannot have one of its own for each guide.
#[test]
fn a_link_that_rides_on_two_guides_is_not_told_to_have_blocks() {
    let text = r#"{ "fixed": { "O2": [0, 0], "O4": [4, 0] }, "placed": { "C": [3, 2], "D": [4, 3] },
        "links": { "2": { "joins": ["O2", "A"], "length": 2 }, "3": { "joins": ["O4", "B"], "length": 2 },
                   "4": { "joins": ["C", "D"] } },
        "slides": [{ "link": 4, "on": { "link": 2, "through": "O2", "toward": "A" } },
                   { "link": 4, "on": { "link": 3, "through": "O4", "toward": "B" } }],
        "input": { "slide": 4, "velocity": 1 }, "find": ["v(C)"] }"#;
    let told = refusal(text);
    assert!(told.contains("slides on two guides") && told.contains("drive a link"), "{told}");
    assert!(!told.contains("block"), "{told}");
}

/// Two sliders on parallel guides that a rod holds apart: both go with the same velocity, and have no centre.
#[test]
fn links_that_do_not_move_against_each_other_have_no_centre() {
    let text = r#"{ "placed": { "A": [0, 0], "B": [3, 1] }, "links": { "2": { "joins": ["A", "B"] } },
        "slides": [{ "pin": "A", "block": 3, "on": { "link": 1, "through": [0, 0], "angle": 0 } },
                   { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 1], "angle": 0 } }],
        "input": { "slide": "A", "velocity": 2 }, "find": ["I(3,4)", "I(2,3)", "I(4,3)"] }"#;
    let scene = scene::read(text, "scene.json").unwrap();
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
    let analytic = solve_analytically(&scene);
    let found = agreement(&scene, &solved, &analytic);
    assert!(found.ok(), "{:e}", found.worst_ratio());
    for (index, told) in [(0, "links 3 and 4"), (2, "links 4 and 3")] {
        let compared = &found.compared[index];
        for answer in [&compared.graphical.answer, &compared.analytic] {
            let why = match answer {
                linkgram::mechanism::quantity::Answer::Indeterminate(why) => why.to_string(),
                other => panic!("{other:?}"),
            };
            assert_eq!(why, format!("{told} do not move against each other"));
        }
    }
}
