//! What a lecturer would not sign, told from the finished sheet alone: pictures of steps smaller than those of the solution or
//! with more on them than is told beside them, a diagram whose scale is set by what nobody needs, an arrow on the link on
//! which it acts, a skeleton made small by a centre beyond it.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::common;
use crate::legibility::{data, has, marks, within};

use kurbo::Point;
use linkgram::catalogue::KINDS;
use linkgram::mechanism::quantity::DiagramKind;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::figure::{Group, Node, Shape};
use linkgram::sheet::{self, Figure, Language};
use linkgram::solve::Solved;

fn kind(name: &str) -> Scene {
    let kind = KINDS.iter().find(|kind| kind.name == name).unwrap();
    linkgram::scene::read(kind.scene, name).unwrap()
}

fn solved(scene: &Scene) -> Solved {
    linkgram::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap()
}

fn solution(scene: &Scene) -> Figure {
    sheet::solution(scene, &solved(scene).solution.construction, Language::English)
}

/// All texts of a group, one after the other, with plain blanks.
fn told(group: &Group) -> String {
    let mut all = String::new();
    group.walk(&mut |node| {
        if let Node::Text(text) = node {
            let own = text.runs.iter().map(|run| run.text.replace(['\u{a0}', '\u{2009}'], " "));
            all.push_str(&own.collect::<String>());
            all.push(' ');
        }
    });
    all
}

/// A hand-out of the steps shows its diagrams as large as the sheet of the solution does.
#[test]
fn pictures_of_the_steps_are_as_large_as_those_of_the_solution() {
    for name in ["six-link", "whitworth", "four-bar", "stephenson", "crank-shaper", "watt", "engine"] {
        let scene = kind(name);
        let whole = solved(&scene).solution.construction;
        let steps = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_steps).unwrap();
        let steps = steps.solution.construction;
        assert!(steps.space.metres_per_mm <= whole.space.metres_per_mm * (1.0 + 1e-9), "{name}");
        for diagram in &whole.diagrams {
            let own = steps.diagram(diagram.kind).unwrap().si_per_mm;
            // What fills a whole page leaves no room for words: it is a step of the scales smaller.
            let page = diagram.kind == DiagramKind::Acceleration || diagram.kind == DiagramKind::Velocity;
            let most = if page { 2.0 } else { 1.0 };
            assert!(own <= most * diagram.si_per_mm * (1.0 + 1e-9), "{name} {:?}", diagram.kind);
        }
    }
}

/// Beside a picture stand no more than four sentences that tell of lines: whoever reads them finds each in it.
#[test]
fn beside_a_picture_of_the_steps_stand_four_acts_at_most() {
    const ACTS: [&str; 8] =
        ["– Through", "– Lay off", "– The lines meet", "– Read", "– Produce", "– Divide", "– About", "– At"];
    let (mut pieces, mut most) = (0, 0);
    for name in ["six-link", "whitworth", "four-bar", "rolling-wheel", "eccentric-pump"] {
        let scene = kind(name);
        let steps = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_steps).unwrap();
        let figure = sheet::step_by_step(&scene, &steps.solution.construction, Language::English);
        for text in within(&figure.root).into_iter().filter(|group| has(group, "steps")) {
            let words = told(text);
            let acts = ACTS.iter().map(|act| words.matches(act).count()).sum::<usize>();
            pieces += 1;
            most = most.max(acts);
            assert!(acts <= 4, "{name}: {words}");
        }
    }
    assert!(pieces >= 30 && most == 4, "{pieces} {most}");
}

/// A slider-crank of which the rod is pushed along itself.
const PUSHED: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 50}, "3": {"joins": ["A", "B"], "length": 160}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": "O2"}}], "near": {"B": [180, 0]},
    "input": {"link": 2, "angle": 60, "omega": "300 rpm ccw"},
    "loads": [{"name": "P", "on": 4, "force": "2 kN", "direction": 180},
    {"name": "Q", "on": 3, "at": "B", "force": "500 N", "direction": 164.3}], "find": ["T(2)", "F(1,2)", "F(3,4)"]}"#;

/// How much of one stroke lies on another.
fn shared((from, to): (Point, Point), (a, b): (Point, Point)) -> f64 {
    let along = (b - a).normalize();
    let beside = [from, to].iter().map(|p| (*p - a).cross(along).abs()).fold(0.0, f64::max);
    if beside > 1.0 {
        return 0.0;
    }
    let [start, end] = [from, to].map(|p| (p - a).dot(along));
    start.max(end).min(a.distance(b)) - start.min(end).max(0.0)
}

#[test]
fn no_force_lies_on_the_link_on_which_it_acts() {
    let scenes = [("pushed", common::read(PUSHED)), ("press", kind("press"))];
    let fives =
        ["1", "2", "16", "20", "21"].map(|number| common::example(&format!("forces/s000-ch5-{number}")));
    let all = scenes.into_iter().chain(fives.into_iter().map(|scene| ("example", scene)));
    let mut arrows = 0;
    for (name, scene) in all {
        let figure = solution(&scene);
        for body in within(&figure.root).into_iter().filter(|group| has(group, "free-body")) {
            let groups = within(body);
            let lines = |class: &'static str| {
                let own = groups.iter().filter(move |group| has(group, class));
                own.flat_map(|group| marks(group)).filter_map(|mark| match mark.shape {
                    Shape::Line(from, to) => Some((from, to)),
                    _ => None,
                })
            };
            for force in lines("applied") {
                arrows += 1;
                for link in lines("link") {
                    let lies = shared(force, link);
                    assert!(lies < 2.5, "{name}: {lies} mm of an arrow on a link in {}", told(body));
                }
            }
        }
    }
    assert!(arrows > 20, "{arrows}");
}

/// The centre of a curved guide lies 250 mm off: the pump stands at a scale at which it can be read, with an arrow there.
#[test]
fn the_centre_of_an_arc_far_off_makes_no_skeleton_small() {
    let scene = kind("eccentric-pump");
    let construction = solved(&scene).solution.construction;
    assert!(construction.space.metres_per_mm <= 0.0025, "{}", construction.space.metres_per_mm);
    let figure = sheet::solution(&scene, &construction, Language::English);
    assert!(told(&figure.root).contains("to E, radius 250 mm"));
    let joints = within(&figure.root).into_iter().filter(|group| has(group, "joint"));
    assert!(joints.filter_map(|group| data(group, "point")).all(|point| point != "E"));
}
