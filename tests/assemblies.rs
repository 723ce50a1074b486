//! Hints choose the assembly: both solvers must take the one that lies nearest.

mod common;

use linkgram::check::agreement;
use linkgram::plan::Extent;
use linkgram::{sheet, solve};

fn agrees(text: &str) {
    let scene = common::read(text);
    let solved = solve::solve(&scene, Extent::Asked, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{error}"));
    let agreement = agreement(&scene, &solved, &solve::solve_analytically(&scene));
    let (refused, branch) = (&agreement.refused, &agreement.wrong_branch);
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
