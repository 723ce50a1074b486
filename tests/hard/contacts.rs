//! Wheels that roll on each other and that nothing holds together.

use serde_json::{Value, json};

use super::folder::Folder;

/// A wheel on the pin A of a rod AB, rolling inside a fixed ring about O; a crank OB drives it, and no link has O and A.
/// B is at [30, 15], A at [30, 0]: v(B) = ω(−15, 30) mm, and a rod AB that keeps no distance of A from O would take A
/// along x as well.
fn on_a_rod(find: &[&str]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] }, "placed": { "A": [30, 0], "B": [30, 15] },
        "links": { "2": { "joins": ["O", "B"] }, "3": { "joins": ["A", "B"] },
                   "4": { "joins": ["B", "C"], "length": 120 } },
        "slides": [{ "pin": "C", "block": 5, "on": { "link": 1, "through": "O", "angle": 0 } }],
        "rolls": [{ "links": [1, 3], "centres": ["O", "A"], "radii": [50, 20], "internal": true }],
        "near": { "C": [150, 0] }, "input": { "link": 2, "omega": "10 rad/s ccw", "alpha": 7 }, "find": find
    })
}

/// A wheel of radius 25 on the coupler of a parallel crank linkage, rolling on a fixed wheel of radius 35 about O: A
/// moves on a circle of radius 60 about O, though no link has both, and the coupler does not turn.
fn on_a_parallelogram() -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0], "P": [0, -40], "Q": [100, -40] },
        "links": { "2": { "joins": ["P", "C"], "length": 60 }, "4": { "joins": ["Q", "D"], "length": 60 },
                   "3": { "joins": ["C", "D", "A"], "sides": [100, 107.703_296_142_690_08, 40] },
                   "5": { "joins": ["A"] } },
        "rolls": [{ "links": [1, 5], "centres": ["O", "A"], "radii": [35, 25] }],
        "near": { "D": [152, -10], "A": [52, 30] },
        "input": { "link": 2, "angle": 30, "omega": "10 rad/s ccw", "alpha": 3 }, "find": ["v(A)", "omega(5)", "alpha(5)"]
    })
}

#[test]
fn wheels_that_nothing_holds_together_are_refused() {
    let folder = Folder::new("contacts");
    for find in [&["omega(3)"][..], &["alpha(3)", "v(B)"]] {
        folder.write("s.json", on_a_rod(find).to_string());
        for command in [&["solve", "s.json"][..], &["check", "s.json"], &["draw", "s.json", "-o", "s.svg"]] {
            let ran = folder.run(command);
            let told = format!("{}{}", ran.out, ran.err);
            assert!(ran.code.is_some_and(|code| code != 0), "{command:?}: {told}");
            assert!(told.contains("links 1 and 3 roll on each other and would come apart"), "{told}");
            assert!(!told.contains("DO NOT AGREE"), "{told}");
        }
    }
    // What hangs on no wheel is answered.
    folder.write("s.json", on_a_rod(&["x(C)", "a(C)"]).to_string());
    let ran = folder.run(&["solve", "s.json"]);
    assert_eq!(ran.code, Some(0), "{}{}", ran.out, ran.err);
}

#[test]
fn a_distance_that_dimensions_hold_is_held() {
    let folder = Folder::new("contacts-held");
    folder.write("s.json", on_a_parallelogram().to_string());
    let ran = folder.run(&["solve", "s.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}{}", ran.out, ran.err);
    let told: Value = serde_json::from_str(&ran.out).unwrap();
    let number = |name: &str| {
        let quantities = told["quantities"].as_array().unwrap();
        let of = quantities.iter().find(|q| q["name"] == name).unwrap();
        of["value"].as_f64().unwrap()
    };
    // A circles O with the crank's ω; Willis: ω₅ = ω (1 + 35/25), and the same of α.
    assert!((number("omega(5)") - 24.0).abs() < 1e-9, "{told}");
    assert!((number("alpha(5)") - 7.2).abs() < 1e-9, "{told}");
}

/// At rest nothing comes apart; as soon as it moves it does.
#[test]
fn what_begins_to_come_apart_is_refused() {
    let folder = Folder::new("contacts-begin");
    let mut scene = on_a_rod(&["alpha(3)"]);
    scene["input"]["omega"] = json!("0 rad/s ccw");
    folder.write("s.json", scene.to_string());
    let ran = folder.run(&["solve", "s.json"]);
    assert!(ran.err.contains("would come apart") && ran.err.contains("/s^2"), "{}{}", ran.out, ran.err);
}
