//! The draughtsman's hand: its error against the closed form of a crank, its proportion to the slips, and
//! draughtsmen with dice against the worst case.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;

use linkgram::graphical::{Draughtsmen, HandError};
use linkgram::plan::Extent;
use linkgram::solve::{Hand, by_hand, solve};

fn errors(text: &str, length: f64, degrees: f64, number: u64) -> (f64, Vec<HandError>) {
    let scene = common::read(text);
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let hand = Hand { length, angle: degrees.to_radians() };
    (solved.scales.length(), by_hand(&scene, &solved, Draughtsmen { hand, number }).unwrap())
}

/// A crank of 50 mm at 30°, and its point's place.
const CRANK: &str = r#"{
    "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
    "links": { "2": { "joins": ["O2", "A"], "length": 50 } },
    "input": { "link": 2, "angle": 30, "omega": 1 }, "find": ["x(A)", "omega(2)"] }"#;

#[test]
fn a_crank_by_hand_errs_as_its_closed_form() {
    let (scale, found) = errors(CRANK, 0.2, 0.3, 2000);
    // x = l cos θ: the length slips, the direction slips, the reading slips; likewise y.
    let slip = 0.2 * scale;
    let turn = 0.05 * 0.3_f64.to_radians();
    let (cos, sin) = (libm::cos(30.0_f64.to_radians()), 0.5);
    let x = slip * cos + turn * sin + slip;
    let y = slip * sin + turn * cos + slip;
    let worst = found[0].worst.unwrap();
    assert!((worst - libm::hypot(x, y)).abs() < 1e-12, "{worst} is not {}", libm::hypot(x, y));
    let spread = found[0].spread.unwrap();
    assert!(spread.largest <= worst * 1.01 && spread.largest > worst / 2.0);
    assert!(spread.median < spread.most && spread.most < spread.largest);
    // What is given and not drawn has no error.
    assert_eq!((found[1].worst, found[1].spread.unwrap().largest), (Some(0.0), 0.0));
    assert_eq!((found[0].failed, found[0].flat), (0, false));
}

#[test]
fn the_worst_case_is_proportional_to_the_slips() {
    let text = common::example_text("s000-ch3a-1");
    let (_, whole) = errors(&text, 0.2, 0.3, 1);
    let (_, half) = errors(&text, 0.1, 0.15, 1);
    for (whole, half) in whole.iter().zip(&half) {
        let (whole, half) = (whole.worst.unwrap(), half.worst.unwrap());
        assert!((whole - 2.0 * half).abs() <= 1e-12 * whole, "{whole} and {half}");
    }
}

#[test]
fn no_draughtsman_is_worse_than_the_worst_case() {
    for path in common::example_paths() {
        let text = std::fs::read_to_string(&path).unwrap();
        let scene = common::read(&text);
        let Ok(solved) = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene) else { continue };
        // A fine pencil, so that second order is small beside first.
        let hand = Hand { length: 0.002, angle: 0.003_f64.to_radians() };
        let found = by_hand(&scene, &solved, Draughtsmen { hand, number: 60 }).unwrap();
        for (asked, error) in scene.mechanism.asked.iter().zip(&found) {
            if let (Some(worst), Some(spread), false) = (error.worst, error.spread, error.flat) {
                let name = format!("{}: {}", path.display(), asked.name);
                assert!(spread.largest <= worst * 1.05 + 1e-15, "{name}: {} > {worst}", spread.largest);
                assert_eq!(error.tolerance(), Some(spread.most));
            }
        }
    }
}

#[test]
fn the_same_draughtsmen_draw_the_same_everywhere() {
    assert_eq!(errors(CRANK, 0.2, 0.3, 50), errors(CRANK, 0.2, 0.3, 50));
}
