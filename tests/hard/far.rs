//! What lies far outside the paper: a line may be stated by a point any distance away and is the same line, so that the
//! sheet neither grows nor breaks by it.

use serde_json::{Value, json};

use super::folder::Folder;

fn offset_slider_crank(through: [f64; 2]) -> Value {
    json!({
        "units": { "length": "mm" }, "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": through, "angle": 0 } }],
        "near": { "B": [180, -40] },
        "input": { "link": 2, "angle": 70, "omega": 10 }, "find": ["v(B)"]
    })
}

/// The size of an SVG, mm.
fn size(svg: &str) -> [f64; 2] {
    let view = svg.split("viewBox=\"").nth(1).and_then(|rest| rest.split('"').next()).unwrap();
    let numbers: Vec<f64> = view.split(' ').map(|word| word.parse().unwrap()).collect();
    [numbers[2], numbers[3]]
}

#[test]
fn a_guide_through_a_far_point_is_the_same_guide() {
    let folder = Folder::new("far-guides");
    folder.write("near.json", offset_slider_crank([0.0, -40.0]).to_string());
    assert_eq!(folder.run(&["draw", "near.json", "-o", "near.svg"]).code, Some(0));
    let read = |name: &str| std::fs::read_to_string(folder.path(name)).unwrap();
    let near = size(&read("near.svg"));
    for x in [1e4, -1e9, 1e14, -1e30, 1e61] {
        folder.write("far.json", offset_slider_crank([x, -40.0]).to_string());
        let ran = folder.run(&["draw", "far.json", "-o", "far.svg"]);
        // Beyond the digits of a number nothing tells where on its line a guide is met: a refusal.
        if x.abs() > 1e12 && ran.code == Some(2) {
            assert!(ran.err.starts_with("error:"), "{x:e}: {}", ran.err);
            continue;
        }
        assert_eq!(ran.code, Some(0), "{x:e}: {}", ran.err);
        let far = size(&read("far.svg"));
        assert!(far[0] <= near[0] && far[1] <= 2.0 * near[1], "{x:e}: {far:?} mm, near {near:?} mm");
    }
    for kind in ["question", "steps"] {
        let ran = folder.run(&["draw", "far.json", "--as", kind, "-o", "far.svg"]);
        assert!(matches!(ran.code, Some(0..=2)) && !ran.err.contains("panicked"), "{kind}: {}", ran.err);
    }
    for ending in ["png", "pdf", "tex", "html"] {
        let ran = folder.run(&["draw", "far.json", "-o", &format!("far.{ending}")]);
        assert!(matches!(ran.code, Some(0..=2)) && !ran.err.contains("panicked"), "{ending}: {}", ran.err);
    }
}
