//! Hints choose the assembly: both solvers must take the one that lies nearest.

use crate::common;

use linkgram::check::agreement;
use linkgram::plan::Extent;
use linkgram::{sheet, solve};

fn agrees(text: &str) {
    let scene = common::read(text);
    let solved = solve::solve(&scene, Extent::Asked, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{error}"));
    let agreement = agreement(&scene, &solved, &solve::solve_analytically(&scene));
    let (refused, branch) = (&agreement.refused, &agreement.elsewhere);
    assert!(agreement.ok(), "{refused:?} {branch:?} {}", agreement.worst_ratio());
}

/// A Stephenson six-bar whose nearest assembly lies within half a degree of the end of the trial link's
/// range, so that no two trials stand on both sides of it (a mutated file).
#[test]
fn an_assembly_at_the_end_of_the_trial_range_is_found() {
    for (o6, crank, coupler) in [(220, 40.0, 90.0), (200, 36.0, 90.0), (200, 40.0, 81.0)] {
        agrees(&format!(
            r#"{{
              "units": {{ "length": "mm" }},
              "fixed": {{ "O2": [0, 0], "O4": [120, 0], "O6": [{o6}, 60] }},
              "links": {{
                "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                "3": {{ "joins": ["A", "B"], "length": {coupler} }},
                "4": {{ "joins": ["B", "C", "D"], "sides": [80, 60, 70] }},
                "5": {{ "joins": ["O4", "C"], "length": 70 }},
                "6": {{ "joins": ["O6", "D"], "length": 75 }}
              }},
              "near": {{ "B": [75, 90], "C": [140, 70], "D": [135, 125] }},
              "input": {{ "link": 2, "angle": 70, "omega": 10, "alpha": 4 }}
            }}"#
        ));
    }
}

/// A straight guide may be given by a point of it that is far away.
#[test]
fn a_guide_given_from_afar_is_the_same_guide() {
    for far in ["0", "1e6", "1e12", "1e16"] {
        let text = common::example_text("s000-ch4-3-210").replace("[0, 50]", &format!("[{far}, 50]"));
        agrees(&text);
    }
}

/// A hint that chooses between assemblies a few centimetres apart chooses beside lengths of kilometres too.
#[test]
fn a_hint_chooses_beside_a_length_ten_million_times_larger() {
    for far in ["1e6", "1e8", "1e9", "1e12"] {
        let line = format!("[0, 203.2, {far}]");
        agrees(&common::example_text("s000-ch4-1").replace("[0, 203.2, 50.8]", &line));
    }
}

/// Where the two circles about `a` and `b` meet: to the left of the way from a to b, and to the right.
fn circles_meet(a: [f64; 2], ra: f64, b: [f64; 2], rb: f64) -> [[f64; 2]; 2] {
    let d = [b[0] - a[0], b[1] - a[1]];
    let square = d[0] * d[0] + d[1] * d[1];
    let along = (square + ra * ra - rb * rb) / (2.0 * square);
    let across = (ra * ra / square - along * along).sqrt();
    [across, -across].map(|t| [a[0] + along * d[0] - t * d[1], a[1] + along * d[1] + t * d[0]])
}

fn place_of_b(text: &str) -> [f64; 2] {
    let scene = common::read(text);
    let state = solve::solve_analytically(&scene).unwrap_or_else(|error| panic!("{error}: {text}"));
    let b = scene.mechanism.point_named("B").unwrap_or_else(|| panic!("no B"));
    state.pose(b).unwrap_or_else(|why| panic!("{why}: {text}")).at.map(|x| 1000.0 * x)
}

/// The independent solver makes no more starts once it has as many assemblies as there can be: it must still have
/// both, whichever the hint wants, and wherever the origins of the links lie.
#[test]
fn both_assemblies_of_a_dyad_are_found() {
    let (crank, coupler, rocker, ground) = (40.0, 120.0, 80.0, 110.0);
    for angle in [0.0_f64, 60.0, 150.0, 200.0, 310.0] {
        let (sin, cos) = libm::sincos(angle.to_radians());
        let a = [crank * cos, crank * sin];
        let places = circles_meet(a, coupler, [ground, 0.0], rocker);
        // The coupler alone, its end guided along y = 12.
        let reach = (coupler * coupler - (12.0 - a[1]) * (12.0 - a[1])).sqrt();
        for (mine, other) in [(0, 1), (1, 0)] {
            let hint = |p: [[f64; 2]; 2]| [0, 1].map(|k| 0.52 * p[mine][k] + 0.48 * p[other][k]);
            let near = hint(places);
            for (three, four) in
                [("A\", \"B", "O4\", \"B"), ("B\", \"A", "O4\", \"B"), ("B\", \"A", "B\", \"O4")]
            {
                let found = place_of_b(&format!(
                    r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [{ground}, 0] }},
                      "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                                 "3": {{ "joins": ["{three}"], "length": {coupler} }},
                                 "4": {{ "joins": ["{four}"], "length": {rocker} }} }},
                      "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": {angle}, "omega": 1 }} }}"#,
                    near[0], near[1]
                ));
                let miss = libm::hypot(found[0] - places[mine][0], found[1] - places[mine][1]);
                assert!(miss < 1e-9, "{angle}: {found:?}, not {:?}", places[mine]);
            }
            let guided = [[a[0] + reach, 12.0], [a[0] - reach, 12.0]];
            let near = hint(guided);
            for three in ["A\", \"B", "B\", \"A"] {
                let found = place_of_b(&format!(
                    r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
                      "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }},
                                 "3": {{ "joins": ["{three}"], "length": {coupler} }} }},
                      "slides": [{{ "pin": "B", "on": {{ "link": 1, "through": [0, 12], "angle": 0 }} }}],
                      "near": {{ "B": [{}, {}] }}, "input": {{ "link": 2, "angle": {angle}, "omega": 1 }} }}"#,
                    near[0], near[1]
                ));
                let miss = libm::hypot(found[0] - guided[mine][0], found[1] - guided[mine][1]);
                assert!(miss < 1e-9, "{angle}: {found:?}, not {:?}", guided[mine]);
            }
        }
    }
}
