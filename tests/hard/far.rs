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
    for x in [1e4, -1e9, 1e11] {
        folder.write("far.json", offset_slider_crank([x, -40.0]).to_string());
        let ran = folder.run(&["draw", "far.json", "-o", "far.svg"]);
        assert_eq!(ran.code, Some(0), "{x:e}: {}", ran.err);
        let far = size(&read("far.svg"));
        assert!(far[0] <= near[0] && far[1] <= 2.0 * near[1], "{x:e}: {far:?} mm, near {near:?} mm");
        for kind in ["question", "steps"] {
            let ran = folder.run(&["draw", "far.json", "--as", kind, "-o", "far.svg"]);
            assert_eq!(ran.code, Some(0), "{x:e} {kind}: {}", ran.err);
        }
        for ending in ["png", "pdf", "tex", "html"] {
            let ran = folder.run(&["draw", "far.json", "-o", &format!("far.{ending}")]);
            assert_eq!(ran.code, Some(0), "{x:e} {ending}: {}", ran.err);
        }
    }
}

/// Where the last digit of a place is no longer small beside the mechanism, nothing tells where a guide is met; it was answered
/// with the origin. A rough place so far away chooses no assembly.
#[test]
fn what_is_absurdly_far_is_refused() {
    let folder = Folder::new("absurdly-far");
    let mut rough = offset_slider_crank([0.0, -40.0]);
    rough["near"]["B"] = json!([1e13, 0]);
    for scene in [
        offset_slider_crank([1e14, -40.0]),
        offset_slider_crank([-1e30, 0.0]),
        offset_slider_crank([1e61, -40.0]),
        rough,
    ] {
        folder.write("far.json", scene.to_string());
        for command in
            [&["solve", "far.json"][..], &["draw", "far.json", "-o", "far.svg"], &["sweep", "far.json"]]
        {
            let ran = folder.run(command);
            assert_eq!(ran.code, Some(2), "{command:?}: {}", ran.err);
            assert!(ran.err.contains("times as far away as the mechanism is large (160 mm)"), "{}", ran.err);
        }
        assert!(!folder.path("far.svg").exists());
    }
}
