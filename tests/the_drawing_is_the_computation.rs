//! The drawing is the computation: the two solvers know nothing of each other, and the graphical numbers
//! come about with the board alone.
//!
//! (That every stroke carries its part of the answers is shown in `nudged_strokes.rs`.)

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::path::{Path, PathBuf};

use linkgram::graphical::construction::Reading;
use linkgram::mechanism::quantity::{Answer, Quantity};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::{graphical, sheet, solve};

/// The code of a source file: without comments, and without its own tests.
fn code_of(path: &Path) -> String {
    let text = std::fs::read_to_string(path).unwrap();
    let before_tests = text.split("#[cfg(test)]").next().unwrap();
    before_tests.lines().map(|line| line.split("//").next().unwrap()).collect::<Vec<_>>().join("\n")
}

fn sources(room: &str) -> Vec<PathBuf> {
    let place = common::root().join("src").join(room);
    if place.is_file() {
        return vec![place];
    }
    let mut found = Vec::new();
    let mut waiting = vec![place];
    while let Some(folder) = waiting.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                waiting.push(path);
            } else if path.extension().is_some_and(|e| e == "rs") && !path.ends_with("tests.rs") {
                found.push(path);
            }
        }
    }
    found.retain(|p| !p.components().any(|c| c.as_os_str() == "tests"));
    assert!(!found.is_empty(), "{room} is gone");
    found
}

/// Whole words of a room's code that name another room or a crate.
fn names(room: &str, strangers: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for path in sources(room) {
        let code = code_of(&path);
        for word in code.split(|c: char| !c.is_alphanumeric() && c != '_') {
            if strangers.contains(&word) {
                found.push(format!("{}: {word}", path.display()));
            }
        }
    }
    found
}

#[test]
fn the_graphical_method_knows_no_other_solver() {
    let strangers = ["nalgebra", "analytic", "check", "render", "solve", "cli", "serde_json"];
    assert_eq!(names("graphical", &strangers), Vec::<String>::new());
    assert_eq!(names("plan.rs", &strangers), Vec::<String>::new());
}

#[test]
fn the_board_knows_no_mechanism() {
    let strangers =
        ["nalgebra", "analytic", "mechanism", "graphical", "plan", "scene", "sheet", "kurbo", "check"];
    assert_eq!(names("board", &strangers), Vec::<String>::new());
}

#[test]
fn the_analytic_solver_knows_no_drawing() {
    let strangers = ["board", "graphical", "plan", "structure", "sheet", "scene", "kurbo"];
    assert_eq!(names("analytic", &strangers), Vec::<String>::new());
}

#[test]
fn the_mechanism_knows_neither_files_nor_solvers() {
    let strangers = ["scene", "board", "graphical", "analytic", "sheet", "nalgebra", "serde_json"];
    assert_eq!(names("mechanism", &strangers), Vec::<String>::new());
}

/// The way of the graphical numbers is scene → structure → plan → board; the analytic solver stands in
/// another function.
#[test]
fn solve_reaches_its_numbers_without_the_analytic_solver() {
    let code = code_of(&common::root().join("src/solve.rs"));
    let body = code.split("pub fn solve(").nth(1).unwrap().split("\npub fn determined(").next().unwrap();
    assert!(body.contains("graphical::solution("));
    for stranger in ["analytic", "State", "render"] {
        assert!(!body.contains(stranger), "solve() names {stranger}");
    }
}

/// What is read off a turning-moment diagram, which is a drawing of its own beside that of the mechanism.
fn read_the_diagram(scene: &Scene, answers: &mut [Reading]) {
    let Some(cycle) = &scene.mechanism.forces.cycle else { return };
    let of_cycle = |quantity: Quantity| match quantity {
        Quantity::Cycle(of) => Some(of),
        _ => None,
    };
    let asked: Vec<_> = scene.mechanism.asked.iter().filter_map(|asked| of_cycle(asked.quantity)).collect();
    if cycle.of().is_some() {
        // A mechanism's own torque is read off its other positions.
        return;
    }
    let g = scene.mechanism.forces.gravity.g;
    let drawn = graphical::cycle::draw(solve::Arithmetic::Double, cycle, g, &asked, None).unwrap();
    for (asked, reading) in scene.mechanism.asked.iter().zip(answers) {
        if let Some(of) = of_cycle(asked.quantity) {
            reading.answer = drawn.answer(of);
        }
    }
}

/// Every graphical number of every example, by the board alone, is the number that `solve` gives.
#[test]
fn the_board_alone_gives_every_number() {
    let mut numbers = 0;
    for path in common::example_paths() {
        let scene = common::read(&std::fs::read_to_string(&path).unwrap());
        if scene.expect.is_some() {
            continue;
        }
        // Only scene, structure, plan and the board are called here, at scales of this test's own.
        let mut drawn = common::try_draw(&scene, Extent::Asked).unwrap();
        read_the_diagram(&scene, &mut drawn.solution.construction.answers);
        let solved = solve::solve(&scene, Extent::Asked, sheet::scale::for_scene).unwrap();
        let pairs = drawn.solution.construction.answers.iter().zip(&solved.solution.construction.answers);
        let own_torque = scene.mechanism.forces.cycle.as_ref().is_some_and(|cycle| cycle.of().is_some());
        for (asked, (alone, whole)) in scene.mechanism.asked.iter().zip(pairs) {
            if own_torque && matches!(asked.quantity, Quantity::Cycle(_)) {
                continue;
            }
            let (apart, bound) = match (&alone.answer, &whole.answer) {
                (Answer::Scalar { value: a, bound: b }, Answer::Scalar { value: c, bound: d }) => {
                    let turn = std::f64::consts::TAU;
                    let apart = (a - c).abs();
                    let is_angle = asked.name.starts_with("angle");
                    (if is_angle { apart.min((turn - apart).abs()) } else { apart }, b + d)
                }
                (Answer::Vector { value: a, bound: b }, Answer::Vector { value: c, bound: d }) => {
                    (common::norm(common::minus(*a, *c)), b + d)
                }
                (
                    Answer::AtInfinity { direction: a, bound: b },
                    Answer::AtInfinity { direction: c, bound: d },
                ) => (common::cross(*a, *c).abs(), b + d),
                (Answer::Indeterminate(_), Answer::Indeterminate(_)) => continue,
                other => panic!("{}: {}: {other:?}", path.display(), asked.name),
            };
            assert!(apart <= bound, "{}: {}: {apart:e} apart, bounds {bound:e}", path.display(), asked.name);
            numbers += 1;
        }
    }
    assert!(numbers > 200, "{numbers}");
}

/// Case s000-ch7-9-36: a four-bar whose polygons have whole numbers for corners. Both solvers give them
/// within their bounds, and the bounds are a few roundings.
#[test]
fn the_integer_four_bar_is_exact() {
    let scene = common::example("s000-ch7-9-36");
    let drawn = common::draw(&scene);
    let state = solve::solve_analytically(&scene).unwrap();
    let scalars = [("omega(3)", 1.0), ("omega(4)", 3.0), ("alpha(3)", 10.0), ("alpha(4)", 5.0)];
    // Corners of the case's polygons (units, here mm), and their differences.
    let vectors = [
        ("v(A)", [-150.0, 36.0]),
        ("v(B)", [-180.0, 90.0]),
        ("v(B/A)", [-30.0, 54.0]),
        ("a(A)", [-216.0, -900.0]),
        ("a(B)", [-570.0, -390.0]),
        ("an(B/A)", [-54.0, -30.0]),
        ("at(B/A)", [-300.0, 540.0]),
        ("an(B)", [-270.0, -540.0]),
        ("at(B)", [-300.0, 150.0]),
    ];
    let quantity = |name: &str| scene.mechanism.asked.iter().find(|a| a.name == name).unwrap().quantity;
    for (name, exact) in scalars {
        for answer in [drawn.answer(name).clone(), state.answer(&quantity(name))] {
            let Answer::Scalar { value, bound } = answer else { panic!("{name}: {answer:?}") };
            assert!((value - exact).abs() <= bound, "{name}: {value} for {exact}, bound {bound:e}");
            assert!(bound < 1e-12 * exact, "{name}: bound {bound:e}");
        }
    }
    for (name, exact) in vectors {
        // The conversion of the test's own numbers to metres is one rounding each.
        let exact: [f64; 2] = exact.map(|x| x / 1000.0);
        let own = common::norm(exact) * f64::EPSILON;
        for answer in [drawn.answer(name).clone(), state.answer(&quantity(name))] {
            let Answer::Vector { value, bound } = answer else { panic!("{name}: {answer:?}") };
            let apart = common::norm(common::minus(value, exact));
            assert!(apart <= bound + own, "{name}: {value:?} for {exact:?}, bound {bound:e}");
            assert!(bound < 1e-12, "{name}: bound {bound:e}");
        }
    }
}
