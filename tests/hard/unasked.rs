//! Parts that nobody asks for: impossible, ambiguous, or beyond all proportion, they change nothing.

use serde_json::{Value, json};

use super::folder::Folder;

fn four_bar() -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [110, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 120 },
                   "4": { "joins": ["O4", "B"], "length": 80 } },
        "near": { "B": [125, 80] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s ccw" },
        "find": ["v(B)", "omega(4)", "alpha(3)"]
    })
}

/// A dyad on A and a fixed point.
fn with_dyad(lengths: [f64; 2], near: Option<[f64; 2]>) -> Value {
    let mut scene = four_bar();
    scene["fixed"]["Q"] = json!([200, 300]);
    scene["links"]["90"] = json!({ "joins": ["A", "Z"], "length": lengths[0] });
    scene["links"]["91"] = json!({ "joins": ["Q", "Z"], "length": lengths[1] });
    if let Some(near) = near {
        scene["near"]["Z"] = json!(near);
    }
    scene
}

#[test]
fn a_sweep_builds_what_is_asked_for() {
    let folder = Folder::new("unasked-sweep");
    folder.write("s.json", four_bar().to_string());
    let right = folder.run(&["sweep", "s.json", "--only", "v(B)", "--steps", "12"]);
    assert_eq!(right.code, Some(0), "{}", right.err);
    let apart = 320.648_390_467_149_34;
    for scene in [
        with_dyad([60.0, 100.0], Some([200.0, 300.0])),
        with_dyad([300.0, 300.0], None),
        with_dyad([1e50, 1e50], Some([0.0, 1e50])),
        with_dyad([1e-50, apart], Some([200.0, 300.0])),
    ] {
        folder.write("s.json", scene.to_string());
        let ran = folder.run(&["sweep", "s.json", "--only", "v(B)", "--steps", "12"]);
        assert_eq!((ran.code, &ran.out), (Some(0), &right.out), "{scene}\n{}", ran.err);
    }
    // The page moves where its own parts do.
    folder.write("s.json", with_dyad([60.0, 100.0], Some([200.0, 300.0])).to_string());
    let ran = folder.run(&["draw", "s.json", "-o", "s.html"]);
    assert_eq!((ran.code, ran.err.contains("does not move")), (Some(0), false), "{}", ran.err);
}

#[test]
fn what_is_far_away_and_unasked_changes_nothing() {
    let folder = Folder::new("unasked-far");
    let values = |scene: &Value| {
        folder.write("s.json", scene.to_string());
        let ran = folder.run(&["solve", "s.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{scene}\n{}{}", ran.out, ran.err);
        let told: Value = serde_json::from_str(&ran.out).unwrap();
        told["quantities"].clone()
    };
    let value = |told: &Value| {
        told.as_array().unwrap().iter().map(|quantity| quantity["value"].clone()).collect::<Vec<_>>()
    };
    let right = value(&values(&four_bar()));
    assert!(!right.is_empty() && right.iter().all(|value| !value.is_null()), "{right:?}");
    for far in [1e14, 1e15, 1e18, 1e59] {
        let mut fixed = four_bar();
        fixed["fixed"]["Q"] = json!([far, far]);
        let mut point = four_bar();
        point["links"]["4"] = json!({ "joins": ["O4", "B", "E"], "line": [0, 80, far] });
        let mut arms = four_bar();
        arms["links"]["4"] = json!({ "joins": ["O4", "B", "E"], "arms": [80, far, 30] });
        let dyad = with_dyad([far, far], Some([0.0, far]));
        let mut first = four_bar();
        first["fixed"] = json!({ "Q": [far, far], "O2": [0, 0], "O4": [110, 0] });
        for scene in [fixed, point, arms, dyad, first] {
            assert_eq!(value(&values(&scene)), right, "{scene}");
        }
    }
    // A rough place that is as far from both is not one that is missing.
    let mut hinted = four_bar();
    hinted["near"]["B"] = json!([1e14, 1e14]);
    folder.write("s.json", hinted.to_string());
    let said = folder.refused(&["solve", "s.json"]);
    assert!(said.contains("as far from [100000000000000, 100000000000000] the one as the other"), "{said}");
}

/// A ratio to a link that does not turn has no value; that link's ω has one.
#[test]
fn a_ratio_to_nothing_spoils_nothing_else() {
    let folder = Folder::new("ratio-to-nothing");
    let mut scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "placed": { "A": [30, 50], "B": [130, 50] },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] } },
        "input": { "link": 2, "omega": 3 },
        "find": ["omega(3)", "ratio(2/3)", "omega(4)", "omega(3/2)"]
    });
    folder.write("s.json", scene.to_string());
    let ran = folder.run(&["solve", "s.json"]);
    assert_eq!(ran.out.matches("indeterminate").count(), 1, "{ran:?}");
    assert!(ran.out.contains("indeterminate: ω3 is zero"), "{ran:?}");
    scene["find"] = json!(["ratio(2/3)"]);
    folder.write("s.json", scene.to_string());
    let ran = folder.run(&["solve", "s.json"]);
    assert!(ran.code != Some(0) && !(ran.out + &ran.err).contains("turn the input"), "{}", ran.err);
}
