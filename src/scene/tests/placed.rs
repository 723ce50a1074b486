use proptest::prelude::*;

use super::{bad, close, good, place};
use crate::mechanism::{Form, Input, Place};
use crate::scene::Scene;

/// Where a point stayed placed.
#[track_caller]
fn placed(scene: &Scene, name: &str) -> [f64; 2] {
    match place(scene, name) {
        Place::Placed(p) => {
            assert!(p.iter().all(|c| c.error.is_finite() && c.error < 1e-12), "{name}: {p:?}");
            p.map(|c| c.value)
        }
        other => panic!("{name} is {other:?}"),
    }
}

/// A four-bar of sides 3, 4, 5 triangles: O2 (0,0), A (3,4), B (9,4), O4 (9,0).
fn four_bar(a: &str, b: &str, dimensions: [&str; 3], input: &str) -> String {
    let [two, three, four] = dimensions;
    format!(
        r#"{{ "fixed": {{ "O2": [0, 0], "O4": [9, 0] }}, "placed": {{ "A": {a}, "B": {b} }},
        "links": {{ "2": {{ "joins": ["O2", "A"]{two} }}, "3": {{ "joins": ["A", "B"]{three} }},
                    "4": {{ "joins": ["O4", "B"]{four} }} }},
        "input": {{ "link": 2, "omega": 1{input} }} }}"#
    )
}

#[test]
fn dimensions_follow_from_places() {
    let scene = good(&four_bar("[3, 4]", "[9, 4]", ["", "", ""], ""));
    assert_eq!(placed(&scene, "A"), [3.0, 4.0]);
    assert_eq!(placed(&scene, "B"), [9.0, 4.0]);
    assert!(scene.mechanism.links.iter().all(|l| l.form == Form::Placed));
    assert!(matches!(scene.mechanism.inputs[0], Input::Angle { angle: None, .. }));
}

/// One given length: the point is moved along its radius. Two: it follows from them.
#[test]
fn given_lengths_hold() {
    let scene = good(&four_bar("[3.000001, 4]", "[9, 4.000002]", [r#", "length": 5"#, "", ""], ""));
    let a = placed(&scene, "A");
    assert!((libm::hypot(a[0], a[1]) - 5.0).abs() < 1e-14);
    assert!((a[0] / a[1] - 3.000001 / 4.0).abs() < 1e-14, "square onto the circle");
    assert_eq!(placed(&scene, "B"), [9.0, 4.000002]);

    let lengths = [r#", "length": 5"#, r#", "length": 6"#, r#", "length": 4"#];
    let scene = good(&four_bar("[3.000001, 4]", "[9, 4.000002]", lengths, ""));
    let a = placed(&scene, "A");
    let Place::Near(b) = place(&scene, "B") else { panic!() };
    assert!((libm::hypot(b[0] - a[0], b[1] - a[1]) - 6.0).abs() < 1e-14);
    assert!((libm::hypot(b[0] - 9.0, b[1]) - 4.0).abs() < 1e-14);
}

#[test]
fn an_input_angle_holds() {
    // atan(4/3), to twelve places.
    let angle = r#", "angle": "0.927295218002 rad""#;
    let scene = good(&four_bar("[3, 4.000001]", "[9, 4]", ["", "", ""], angle));
    let a = placed(&scene, "A");
    assert!((libm::atan2(a[1], a[0]) - 0.927295218002).abs() < 1e-15);
    assert!(matches!(scene.mechanism.inputs[0], Input::Angle { angle: None, .. }));

    let scene = good(
        &four_bar("[3, 4.000001]", "[9, 4]", [r#", "length": 5"#, "", r#", "length": 4"#], angle)
            .replace(r#""3": { "joins": ["A", "B"] }"#, r#""3": { "joins": ["A", "B"], "length": 6 }"#),
    );
    assert!(matches!(place(&scene, "A"), Place::Near(_)));
    let Input::Angle { angle: Some(angle), .. } = scene.mechanism.inputs[0] else { panic!() };
    close(angle, 0.927295218002);

    let error = bad(&four_bar("[3, 4]", "[9, 4]", ["", "", ""], r#", "angle": 60"#));
    assert_eq!(error.path, "placed.A");
    assert!(
        error.what.contains("from O2 to A is placed at 53.1301 deg, but the input gives link 2 60 deg"),
        "{error}"
    );
    let error = bad(&four_bar("[3, 4]", "[9, 4]", ["", "", ""], r#", "angle": -126.86989764584402"#));
    assert!(error.what.contains("53.1301 deg"), "{error}");
}

#[test]
fn contradictions_name_both() {
    let error = bad(&four_bar("[3, 4]", "[9, 4]", [r#", "length": 5.1"#, "", ""], ""));
    assert_eq!((error.path.as_str(), error.line), ("placed.A", 1));
    assert!(error.what.contains("A is placed 5 m from O2, but link 2 makes it 5.1 m"), "{error}");
    assert!(error.mend.unwrap().contains("taken as rounding"));
    let error = bad(&four_bar("[3, 4]", "[9, 4]", ["", r#", "length": 7"#, ""], ""));
    assert!(error.what.contains("6 m from") && error.what.contains("link 3 makes it 7 m"), "{error}");
}

const SLIDER: &str = r#"{ "fixed": { "O": [0, 0] }, "placed": { "A": [3, 4], "B": [9, 0.000003] },
    "links": { "2": { "joins": ["O", "A"] }, "3": { "joins": ["A", "B"] } },
    "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O" } } ],
    "input": { "link": 2, "omega": 1 } }"#;

#[test]
fn a_placed_pin_is_brought_square_onto_its_guide() {
    assert_eq!(placed(&good(SLIDER), "B"), [9.0, 0.0]);
    let error = bad(&SLIDER.replace("0.000003", "0.1"));
    assert_eq!(error.path, "placed.B");
    assert!(error.what.contains("B is placed 0.1 m beside its guide on link 1"), "{error}");
    // An arc guide, and a guide that is shifted.
    let arc = SLIDER.replace(r#""link": 1, "through": "O""#, r#""link": 1, "centre": "O", "radius": 9"#);
    let b = placed(&good(&arc), "B");
    assert!((libm::hypot(b[0], b[1]) - 9.0).abs() < 1e-14);
    let shifted =
        SLIDER.replace(r#""through": "O""#, r#""through": "O", "offset": 2"#).replace("0.000003", "2.000003");
    assert_eq!(placed(&good(&shifted), "B"), [9.0, 2.0]);
}

#[test]
fn a_driven_slide_holds() {
    let driven = SLIDER.replace(r#""link": 2, "omega": 1"#, r#""slide": "B", "velocity": 1"#);
    assert_eq!(placed(&good(&driven), "B"), [9.0, 0.0]);
    let at = driven.replace(r#""velocity""#, r#""at": 8.999999, "velocity""#);
    // Link 3 is dimensioned by placement, so its points stay exact.
    assert!((placed(&good(&at), "B")[0] - 8.999999).abs() < 1e-14);
    let error = bad(&driven.replace(r#""velocity""#, r#""at": 8, "velocity""#));
    assert!(error.what.contains("B is placed 1") && error.what.contains("`at`"), "{error}");
}

/// A slotted lever: the pin goes to the slot, and where the crank has a length, to both.
#[test]
fn a_pin_on_a_moving_guide() {
    let text = r#"{ "fixed": { "O2": [0, 0], "O4": [0, -3] }, "placed": { "A": [4.000002, 0], "B": [8, 3] },
        "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4", "B"] } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } } ],
        "input": { "link": 2, "omega": 1 } }"#;
    let scene = good(text);
    assert_eq!(placed(&scene, "B"), [8.0, 3.0]);
    let a = placed(&scene, "A");
    // Square onto the line through (0,-3) with slope 3/4.
    assert!((a[1] + 3.0 - 0.75 * a[0]).abs() < 1e-14);
    assert!(((a[0] - 4.000002) * 4.0 + a[1] * 3.0).abs() < 1e-14);

    let scene = good(&text.replace(r#"["O2", "A"]"#, r#"["O2", "A"], "length": 4"#));
    let a = placed(&scene, "A");
    assert!((a[1] + 3.0 - 0.75 * a[0]).abs() < 1e-14);
    assert!((libm::hypot(a[0], a[1]) - 4.0).abs() < 1e-14);
    assert!(bad(&text.replace("4.000002", "4.1")).what.contains("guide on link 4"));
}

#[test]
fn mirror_images_are_seen() {
    let text = r#"{ "fixed": { "O": [0, 0] }, "placed": { "A": [4, 0], "B": [4, -3] },
        "links": { "2": { "joins": ["O", "A", "B"], "sides": [4, 3, 5] } }, "input": { "link": 2, "omega": 1 } }"#;
    let error = bad(text);
    assert!(error.what.contains("mirror image of link 2"), "{error}");
    let scene = good(&text.replace("[4, 3, 5]", "[4, 3, 5], \"turn\": \"cw\""));
    assert_eq!(placed(&scene, "B"), [4.0, -3.0]);
}

#[test]
fn rolling_contact_holds_a_centre() {
    let text = r#"{ "fixed": { "O": [0, 0] }, "placed": { "A": [3.000002, 4] },
        "links": { "2": { "joins": ["O"] }, "3": { "joins": ["A"] } },
        "rolls": [ { "links": [2, 3], "centres": ["O", "A"], "radii": [2, 3] } ] }"#;
    let a = placed(&good(text), "A");
    assert!((libm::hypot(a[0], a[1]) - 5.0).abs() < 1e-14);
    assert!(bad(&text.replace("[2, 3] }", "[2, 4] }")).what.contains("rolls[0] make it 6 m"));
    // What an arm and the radii say of one distance is one fact.
    let arm = text.replace(r#""3": {"#, r#""4": { "joins": ["O", "A"], "length": 5 }, "3": {"#);
    good(&arm);
    let told = bad(&arm.replace("\"radii\": [2, 3] }", "\"radii\": [2, 4] }")).what;
    assert!(told.contains("the distance of O and A 6 m, but link 4 makes it 5 m"), "{told}");
    let plane = text.replace(
        r#""links": [2, 3], "centres": ["O", "A"], "radii": [2, 3]"#,
        r#""links": [1, 3], "line": { "through": [0, 1.000003] }, "centre": "A", "radius": 3"#,
    );
    let a = placed(&good(&plane), "A");
    assert!(a[0] == 3.000002 && (a[1] - 4.000003).abs() < 1e-14, "{a:?}");
}

proptest! {
    /// A figure's digits are always accepted, and what they are brought onto then holds: every given
    /// length between exact points, whichever lengths are given.
    #[test]
    fn rounded_figures_are_settled(
        a in prop::array::uniform2(-5.0..5.0_f64),
        b in prop::array::uniform2(5.0..15.0_f64),
        misses in prop::array::uniform4(-3e-7..3e-7_f64),
        given in prop::array::uniform3(any::<bool>()),
        angle in any::<bool>(),
    ) {
        let distance = |p: [f64; 2], q: [f64; 2]| libm::hypot(p[0] - q[0], p[1] - q[1]);
        prop_assume!(distance(a, [0.0; 2]) > 0.1 && distance(b, [9.0, 0.0]) > 0.1);
        let lengths = [distance(a, [0.0; 2]), distance(a, b), distance(b, [9.0, 0.0])];
        let dimension = |i: usize| if given[i] { format!(r#", "length": {:?}"#, lengths[i]) } else { String::new() };
        let dimensions = [dimension(0), dimension(1), dimension(2)];
        let [two, three, four] = &dimensions;
        let input = if angle { format!(r#", "angle": "{:?} rad""#, libm::atan2(a[1], a[0])) } else { String::new() };
        let [ax, ay, bx, by] = [a[0] + misses[0], a[1] + misses[1], b[0] + misses[2], b[1] + misses[3]];
        let scene = good(&four_bar(&format!("[{ax:?}, {ay:?}]"), &format!("[{bx:?}, {by:?}]"), [two, three, four], &input));
        let ends = [("O2", "A"), ("A", "B"), ("O4", "B")];
        for (i, (from, to)) in ends.into_iter().enumerate() {
            let (from, to) = (place(&scene, from), place(&scene, to));
            if let (true, Some(p), Some(q)) = (given[i], from.exact(), to.exact()) {
                let found = distance(p.map(|c| c.value), q.map(|c| c.value));
                let allowed = p.iter().chain(&q).map(|c| c.error).sum::<f64>() + 1e-13;
                prop_assert!((found - lengths[i]).abs() < allowed.min(1e-10), "{i}: {found} {}", lengths[i]);
            }
        }
        let exact = |name| place(&scene, name).exact().is_some();
        // Without an angle the drive stays exact; a link dimensioned by placement keeps exact points.
        prop_assert!(exact("A") || angle);
        for (link, points) in [(0, ["A", "O2"]), (1, ["A", "B"]), (2, ["B", "O4"])] {
            prop_assert!(given[link] || points.into_iter().all(exact));
        }
        for name in ["A", "B"] {
            let hint = place(&scene, name).hint().unwrap();
            let raw = if name == "A" { [ax, ay] } else { [bx, by] };
            // Where two circles graze, their meeting point may lie some way off.
            prop_assert!(distance(hint, raw) < 1e-2, "{name} went from {raw:?} to {hint:?}");
        }
    }
}
