//! The plan holds the steps that the asked quantities need, and no other.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use linkgram::mechanism::quantity::{DiagramKind, Order};
use linkgram::mechanism::structure::Structure;
use linkgram::plan::{Extent, Plan};
use linkgram::scene::Scene;

fn asking(stem: &str, find: &[&str]) -> Scene {
    let mut value: serde_json::Value = serde_json::from_str(&common::example_text(stem)).unwrap();
    value["find"] = serde_json::json!(find);
    common::read(&value.to_string())
}

/// Number of steps of the skeleton, the velocity and the acceleration polygon.
fn steps(stem: &str, find: &[&str]) -> [usize; 3] {
    let (_, _, plan) = planned(stem, find);
    [
        plan.steps(Order::Position).len(),
        plan.steps(Order::Velocity).len(),
        plan.steps(Order::Acceleration).len(),
    ]
}

fn planned(stem: &str, find: &[&str]) -> (Scene, Structure, Plan) {
    let scene = asking(stem, find);
    let structure = Structure::of(&scene.mechanism).unwrap();
    let plan = Plan::new(&scene.mechanism, &structure, Extent::Asked);
    (scene, structure, plan)
}

const SIX: &str = "s000-ch3a-1";

#[test]
fn the_velocity_of_b_needs_neither_accelerations_nor_what_hangs_behind_b() {
    assert_eq!(steps(SIX, &["v(B)"]), [2, 2, 0]);
    let drawn = common::try_draw(&asking(SIX, &["v(B)"]), Extent::Asked).unwrap();
    let construction = &drawn.solution.construction;
    assert!(construction.diagram(DiagramKind::Acceleration).is_none());
    // C and D are not drawn, not even on the skeleton.
    for name in ["C", "D"] {
        assert_eq!(construction.space.places[drawn.point(name).0], None, "{name}");
    }
    let solved: Vec<u32> = construction
        .steps
        .iter()
        .flat_map(|s| &s.links)
        .map(|&l| drawn.scene.mechanism.link(l).number)
        .collect();
    assert!(!solved.is_empty() && solved.iter().all(|n| [2, 3, 4].contains(n)), "{solved:?}");
    assert!(construction.steps.iter().all(|s| s.diagram != DiagramKind::Acceleration));
    // The number is that of the whole solution.
    let (whole, bound) = common::draw(&common::example(SIX)).vector("v(B)");
    let (alone, other) = drawn.vector("v(B)");
    assert!(common::norm(common::minus(whole, alone)) <= bound + other);
}

#[test]
fn steps_are_counted_by_what_is_asked() {
    assert_eq!(steps(SIX, &["v(A)"]), [1, 1, 0]);
    assert_eq!(steps(SIX, &["x(A)"]), [1, 0, 0]);
    assert_eq!(steps(SIX, &["x(D)"]), [3, 0, 0]);
    assert_eq!(steps(SIX, &["omega(2)"])[1..], [1, 0]);
    assert_eq!(steps(SIX, &["omega(4)"]), [2, 2, 0]);
    assert_eq!(steps(SIX, &["v(C)"]), [2, 2, 0]);
    assert_eq!(steps(SIX, &["v(D)"]), [3, 3, 0]);
    assert_eq!(steps(SIX, &["a(B)"]), [2, 2, 2]);
    assert_eq!(steps(SIX, &["alpha(5)"]), [3, 3, 3]);
    // Accelerations up to B, velocities up to D.
    assert_eq!(steps(SIX, &["a(B)", "v(D)"]), [3, 3, 2]);
    assert_eq!(steps(SIX, &["rub(B)"]), [2, 2, 0]);
    assert_eq!(steps(SIX, &["transmission(3/4)"]), [2, 0, 0]);
}

#[test]
fn only_the_branch_that_is_asked_for_is_solved() {
    // Of the two rods behind the coupler, one each.
    assert_eq!(steps("eight-link", &["v(F)"]), [3, 3, 0]);
    assert_eq!(steps("eight-link", &["a(G)"]), [3, 3, 3]);
    assert_eq!(steps("eight-link", &["v(F)", "a(G)"]), [4, 4, 3]);
    let (scene, structure, plan) = planned("eight-link", &["v(G)"]);
    let groups: Vec<usize> = plan.steps(Order::Velocity).iter().map(|s| s.group).collect();
    let group = |number| structure.group_of(scene.mechanism.link_numbered(number).unwrap()).unwrap();
    assert_eq!(groups, vec![group(2), group(3), group(7)]);
    // E, the third corner of the coupler, carries only the other rod: it is not transferred.
    let e = scene.mechanism.point_named("E").unwrap();
    assert!(plan.steps(Order::Velocity).iter().all(|s| s.points.iter().all(|(_, p)| *p != e)));
    assert!(plan.steps(Order::Position).iter().all(|s| s.points.iter().all(|(_, p)| *p != e)));
}

#[test]
fn the_whole_skeleton_adds_positions_and_nothing_else() {
    let scene = asking(SIX, &["v(B)"]);
    let structure = Structure::of(&scene.mechanism).unwrap();
    let plan = Plan::new(&scene.mechanism, &structure, Extent::WholeSkeleton);
    assert_eq!(
        [
            plan.steps(Order::Position).len(),
            plan.steps(Order::Velocity).len(),
            plan.steps(Order::Acceleration).len()
        ],
        [3, 2, 0]
    );
    assert_eq!(plan.steps(Order::Position).len(), 3);
}

#[test]
fn the_explanation_says_what_was_kept_and_skipped() {
    let (scene, structure, plan) = planned(SIX, &["v(B)"]);
    let text = plan.explain(&scene.mechanism, &structure).to_string();
    let lines: Vec<&str> = text.lines().collect();
    assert!(lines[0].starts_with("mobility: n = 6") && lines[0].ends_with("= 1"), "{}", lines[0]);
    assert_eq!(lines.len(), 1 + 9, "three groups at three orders:\n{text}");
    let verdicts: Vec<(bool, bool)> =
        lines[1..].iter().map(|l| (l.starts_with("kept"), l.starts_with("skipped"))).collect();
    let kept = (true, false);
    let skipped = (false, true);
    assert_eq!(verdicts, [kept, kept, skipped, kept, kept, skipped, skipped, skipped, skipped], "{text}");
    assert!(lines[3].contains("RRP of links 5, 6") && lines[3].contains("nothing asked needs it"), "{text}");
    assert!(lines[7].contains("acceleration: driver of links 2"), "{text}");
}

#[test]
fn nothing_asked_twice_is_drawn_twice() {
    let once = common::try_draw(&asking(SIX, &["a(D)"]), Extent::Asked).unwrap();
    let twice = common::try_draw(&asking(SIX, &["a(D)", "a(D)", "v(D)"]), Extent::Asked).unwrap();
    assert_eq!(once.plan, twice.plan);
    assert_eq!(once.solution.tape.strokes().len(), twice.solution.tape.strokes().len());
    assert_eq!(once.answer("a(D)"), twice.answer("a(D)"));
}
