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

/// Where the last digit of a place is no longer small beside the mechanism, nothing tells where a guide is met: that is
/// neither the origin nor anywhere on a sheet. (A crank and rocker whose coupler drives a slider besides.)
#[test]
fn a_place_that_nothing_tells_is_not_the_origin() {
    let folder = Folder::new("nowhere");
    let scene = |asked: &str| {
        json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [160, 20] },
            "links": {
                "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 150 },
                "4": { "joins": ["O4", "B"], "length": 100 }, "7": { "joins": ["B", "G"], "length": 190 }
            },
            "slides": [{ "pin": "G", "block": 8, "on": { "link": 1, "through": [1e61, -40], "angle": 0 } }],
            "near": { "B": [185, 120], "G": [290, -40] },
            "input": { "link": 2, "angle": 70, "omega": 10 }, "find": [asked]
        })
    };
    folder.write("asked.json", scene("x(G)").to_string());
    let ran = folder.run(&["solve", "asked.json"]);
    assert!(matches!(ran.code, Some(1 | 2)) && !ran.out.contains("(0, 0)"), "{}{}", ran.out, ran.err);
    assert!((ran.out + &ran.err).contains("do not tell where it lies"), "{}", ran.err);
    folder.write("unasked.json", scene("omega(4)").to_string());
    assert_eq!(folder.run(&["solve", "unasked.json"]).code, Some(0));
    let ran = folder.run(&["draw", "unasked.json", "-o", "far.svg"]);
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert!(ran.err.contains("x(G)") && !folder.path("far.svg").exists(), "{}", ran.err);
}

/// A rough place that its digits do not tell from the middle of two assemblies chooses none of them, and leaves the choice to
/// no other: the scene is told so, by the name of the place.
#[test]
fn a_rough_place_beyond_all_digits_is_named() {
    let folder = Folder::new("rough-far");
    let scene = json!({
        "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 45 }, "3": { "joins": ["A", "B", "G"], "line": [0, 160, 50] } },
        "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O2", "angle": 90 } }],
        "input": { "link": 2, "angle": 50, "omega": 10 }, "near": { "B": [46, 1e12], "G": [-1, 1] }, "find": ["x(B)"]
    });
    folder.write("s.json", scene.to_string());
    let said = folder.refused(&["solve", "s.json"]);
    assert!(said.contains("near.B") && said.contains("[46, 1000000000000] the one as the other"), "{said}");
}
