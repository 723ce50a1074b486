//! Scenes whose parts contradict each other, rates that are next to nothing, and paths as people write them.

use serde_json::{Value, json};

use super::folder::Folder;

/// A four-bar linkage whose crank points to 60°: A is at 40 (cos 60°, sin 60°).
fn four_bar(near: [f64; 2], omega: &str, find: &[&str]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [110, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 120 },
                   "4": { "joins": ["O4", "B"], "length": 80 } },
        "near": { "B": near }, "input": { "link": 2, "angle": 60, "omega": omega }, "find": find
    })
}

/// Where the circles about two points meet, to the left of the line from the first to the second.
fn meet(a: [f64; 2], r: f64, b: [f64; 2], s: f64) -> [f64; 2] {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let d = libm::hypot(dx, dy);
    let along = (r * r - s * s + d * d) / (2.0 * d);
    let across = libm::sqrt(r * r - along * along);
    [a[0] + (along * dx - across * dy) / d, a[1] + (along * dy + across * dx) / d]
}

#[test]
fn a_rough_place_that_dimensions_do_not_allow_is_told() {
    let folder = Folder::new("conflicts-near");
    // B is 80 mm from O4, wherever it is looked for; of its two places the nearer one is meant by both solvers.
    let upper = meet([20.0, 40.0 * libm::sin(60_f64.to_radians())], 120.0, [110.0, 0.0], 80.0);
    for (near, sign) in [([1250.0, 800.0], 1.0), ([110.0, 700.0], 1.0), ([110.0, -700.0], -1.0)] {
        folder.write("s.json", four_bar(near, "10 rad/s ccw", &["x(B)", "omega(4)"]).to_string());
        let ran = folder.run(&["solve", "s.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{}{}", ran.out, ran.err);
        assert!(ran.err.contains("near.B: the rough place of B does not hold"), "{}", ran.err);
        let told: Value = serde_json::from_str(&ran.out).unwrap();
        let at: Vec<f64> = told["quantities"][0]["value"]
            .as_array()
            .unwrap()
            .iter()
            .map(|number| number.as_f64().unwrap())
            .collect();
        assert!(at[1] * sign > 0.0, "{at:?}");
        let away = libm::hypot(at[0] - upper[0], at[1] - upper[1]);
        assert!(sign < 0.0 || away < 1e-9, "{at:?} and {upper:?}");
    }
}

/// An instant centre hangs on no speed: it is the same however slowly the input turns.
#[test]
fn centres_are_the_same_at_any_speed() {
    let folder = Folder::new("conflicts-slow");
    let a = [20.0, 40.0 * libm::sin(60_f64.to_radians())];
    let b = meet(a, 120.0, [110.0, 0.0], 80.0);
    // I(1,3) is where O2A and O4B meet.
    let cross = |u: [f64; 2], v: [f64; 2]| u[0] * v[1] - u[1] * v[0];
    let o4b = [b[0] - 110.0, b[1]];
    let t = cross([110.0, 0.0], o4b) / cross(a, o4b);
    let pole = [t * a[0], t * a[1]];
    for omega in ["10 rad/s ccw", "1e-12 rad/s ccw", "1e-30 rad/s cw"] {
        folder.write("s.json", four_bar([125.0, 80.0], omega, &["I(2,3)", "I(1,3)"]).to_string());
        let ran = folder.run(&["solve", "s.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{omega}: {}{}", ran.out, ran.err);
        let told: Value = serde_json::from_str(&ran.out).unwrap();
        for (index, right) in [a, pole].into_iter().enumerate() {
            let at = &told["quantities"][index]["value"];
            let [x, y] = [0, 1].map(|axis| at[axis].as_f64().unwrap());
            assert!(libm::hypot(x - right[0], y - right[1]) < 1e-9, "{omega}: {at} and {right:?}");
        }
    }
}

#[test]
fn a_suite_takes_paths_as_people_write_them_and_names_what_is_too_large() {
    let folder = Folder::new("conflicts-suite");
    let mut scene = four_bar([125.0, 80.0], "10 rad/s ccw", &["omega(4)"]);
    for name in ["a", "a/b", "g"] {
        std::fs::create_dir(folder.path(name)).unwrap();
    }
    folder.write("a/b/s.json", scene.to_string());
    folder.write("g/suite.json", json!({ "figures": [{ "scenes": ["../a//b/s.json"] }] }).to_string());
    assert_eq!(folder.run(&["golden", "bless", "g"]).code, Some(0));
    assert_eq!(folder.run(&["golden", "check", "g"]).code, Some(0));
    // Some 60 m of paper have more pixels than a picture may.
    scene["sheet"] = json!({ "scales": { "length": "1:0.005" } });
    folder.write("a/b/s.json", scene.to_string());
    let ran = folder.run(&["golden", "check", "g"]);
    assert!(matches!(ran.code, Some(1 | 2)) && ran.err.contains("s: 48 dots per inch"), "{ran:?}");
}
