//! Errors planted in either solver, which `check` must catch.
//!
//! | planted | in the drawing | in the analytic state |
//! |---|---|---|
//! | sign of one answer flipped | every answer of every example | whole motion, by a reversed input |
//! | direction of a vector turned by 90° | every vector of every example | – |
//! | a number off by a part in 10⁹ | every answer of every example | a length, an angle, an ω off by 10⁻⁹ |
//! | normal part dropped from a(B) | by hand | ω = 0 under the same α |
//! | tangential part dropped from a(B) | by hand | α = 0 |
//! | Coriolis omitted | by hand, in the slotted lever | – |
//! | ω taken for α, two links exchanged | by hand | – |
//! | forces: F_in, T_in, side of h, weights, tangents, leans | every one of the public scenes | pressure of teeth |
//! | wrong branch | mirrored `near` | mirrored `near` |
//! | refusal | – | a length with which the chain does not close |
//!
//! The drawing's errors are planted in its answers, those of the analytic solver in the mechanism that it
//! alone sees: its state has no door for a false number. A planted error that `check` does not notice fails
//! the test; so does a finding where nothing was planted.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use linkgram::analytic::{AnalyticError, State};
use linkgram::check::{Agreement, agreement};
use linkgram::graphical::{Departure, Searched, Twist, sketch};
use linkgram::mechanism::Input;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet;
use linkgram::solve::{self, Solved};

/// A scene solved by both.
struct Both {
    scene: Scene,
    solved: Solved,
    state: Result<State, AnalyticError>,
}

fn both(scene: &Scene) -> Both {
    let solved = solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
    Both { scene: scene.clone(), solved, state: solve::solve_analytically(scene) }
}

impl Both {
    fn agreement(&self) -> Agreement {
        agreement(&self.scene, &self.solved, &self.state)
    }

    fn index(&self, name: &str) -> usize {
        let found = self.scene.mechanism.asked.iter().position(|a| a.name == name);
        found.unwrap_or_else(|| panic!("{name} is not asked"))
    }

    fn drawn(&mut self, index: usize) -> &mut Answer {
        &mut self.solved.solution.construction.answers[index].answer
    }

    fn vector(&mut self, name: &str) -> [f64; 2] {
        let index = self.index(name);
        match self.drawn(index) {
            Answer::Vector { value, .. } => *value,
            other => panic!("{name}: {other:?}"),
        }
    }

    /// Plants a false vector, asserts that just it is noticed, and puts the true one back.
    fn notices_vector(&mut self, name: &str, planted: [f64; 2]) {
        let index = self.index(name);
        let truth = self.drawn(index).clone();
        if let Answer::Vector { value, .. } = self.drawn(index) {
            *value = planted;
        }
        assert_noticed(&self.agreement(), name);
        *self.drawn(index) = truth;
        assert!(self.agreement().ok());
    }
}

/// Not ok, and the named quantity is the one that says so.
fn assert_noticed(agreement: &Agreement, name: &str) {
    assert!(!agreement.ok(), "a planted error in {name} was not noticed");
    assert!(agreement.worst_ratio() > 1.0);
    for c in &agreement.compared {
        let apart = c.difference.is_some_and(|d| d.ratio > 1.0);
        assert_eq!(apart, c.asked.name == name, "{}", c.asked.name);
    }
}

/// Every example that is to be solved.
fn examples() -> Vec<(String, Scene)> {
    let scenes = common::example_paths().into_iter().map(|path| {
        let scene = common::read(&std::fs::read_to_string(&path).unwrap());
        (path.display().to_string(), scene)
    });
    scenes.filter(|(_, scene)| scene.expect.is_none()).collect()
}

/// Plants one error in each answer of each example in turn. `plant` says nothing where it cannot tell, as
/// for the sign of zero.
fn plant_everywhere(plant: impl Fn(&Answer) -> Option<Answer>) -> usize {
    let mut planted = 0;
    for (name, scene) in examples() {
        let mut both = both(&scene);
        assert!(both.agreement().ok(), "{name} is not sound to begin with");
        for index in 0..scene.mechanism.asked.len() {
            let truth = both.drawn(index).clone();
            let Some(error) = plant(&truth) else { continue };
            *both.drawn(index) = error;
            // An angle that is turned by a whole turn is the same angle.
            let agreement = both.agreement();
            assert!(!agreement.ok(), "{name}: {} was not noticed", scene.mechanism.asked[index].name);
            assert!(agreement.compared[index].difference.unwrap().ratio > 1.0);
            *both.drawn(index) = truth;
            planted += 1;
        }
    }
    planted
}

/// A value that exceeds its bound and of rounding.
fn clear(size: f64, bound: f64) -> bool {
    size > 1e3 * bound
}

#[test]
fn a_flipped_sign_is_noticed_in_every_answer() {
    let planted = plant_everywhere(|answer| match *answer {
        // Half a turn has no sign.
        Answer::Scalar { value, bound }
            if clear(value.abs(), bound) && (value.abs() - std::f64::consts::PI).abs() > 1e-6 =>
        {
            Some(Answer::Scalar { value: -value, bound })
        }
        Answer::Vector { value, bound } if clear(common::norm(value), bound) => {
            Some(Answer::Vector { value: value.map(|x| -x), bound })
        }
        _ => None,
    });
    assert!(planted > 200, "{planted}");
}

#[test]
fn a_turned_vector_is_noticed() {
    let planted = plant_everywhere(|answer| match *answer {
        Answer::Vector { value: [x, y], bound } if clear(libm::hypot(x, y), bound) => {
            Some(Answer::Vector { value: [-y, x], bound })
        }
        _ => None,
    });
    assert!(planted > 100, "{planted}");
}

#[test]
fn a_number_off_by_a_billionth_is_noticed() {
    const OFF: f64 = 1.0 + 1e-9;
    let planted = plant_everywhere(|answer| match *answer {
        // Bounds of the examples are far finer than a part in 10⁹.
        Answer::Scalar { value, bound } if 1e-10 * value.abs() > bound => {
            Some(Answer::Scalar { value: value * OFF, bound })
        }
        Answer::Vector { value, bound } if 1e-10 * common::norm(value) > bound => {
            Some(Answer::Vector { value: value.map(|x| x * OFF), bound })
        }
        _ => None,
    });
    assert!(planted > 200, "{planted}");
}

#[test]
fn a_dropped_part_of_an_acceleration_is_noticed() {
    let mut six = both(&common::example("s000-ch3a-1"));
    assert!(six.agreement().ok());
    let [a_b, normal, tangential] = ["a(B)", "an(B)", "at(B)"].map(|n| six.vector(n));
    six.notices_vector("a(B)", common::minus(a_b, normal));
    six.notices_vector("a(B)", common::minus(a_b, tangential));
    // The normal part laid off away from the pivot instead of towards it.
    six.notices_vector("an(B)", normal.map(|x| -x));
    six.notices_vector("a(B)", common::minus(a_b, common::plus(normal, normal)));
    let [a_d, of_rod] = ["a(D)", "an(D/C)"].map(|n| six.vector(n));
    // The normal part of rod CD is one millimetre on the printed sheet: it is drawn as a point there.
    six.notices_vector("a(D)", common::minus(a_d, of_rod));
}

#[test]
fn an_omitted_coriolis_acceleration_is_noticed() {
    let mut planted = 0;
    for (_, scene) in examples() {
        let names: Vec<String> = scene.mechanism.asked.iter().map(|a| a.name.clone()).collect();
        for (index, coriolis) in names.iter().enumerate().filter(|(_, n)| n.starts_with("coriolis(")) {
            let slide = coriolis.strip_prefix("coriolis").unwrap();
            let under = slide.replace('/', "@");
            let mut both = both(&scene);
            let Answer::Vector { value, bound } = *both.drawn(index) else { continue };
            if !clear(common::norm(value), bound) {
                continue;
            }
            // Without it the slip or the coincident point takes it up.
            for other in [format!("aslip{slide}"), format!("at{under}"), format!("a{under}")] {
                if names.contains(&other) {
                    let truth = both.vector(&other);
                    both.notices_vector(&other, common::plus(truth, value));
                    planted += 1;
                }
            }
            // Its sense is that of ω × slip.
            both.notices_vector(coriolis, value.map(|x| -x));
            planted += 1;
        }
    }
    assert!(planted >= 4, "{planted}");
}

#[test]
fn exchanged_answers_are_noticed() {
    let mut six = both(&common::example("s000-ch3a-1"));
    let pairs = [("omega(3)", "omega(4)"), ("omega(3)", "alpha(3)"), ("v(B)", "v(C)"), ("v(B)", "v(B/A)")];
    for (one, other) in pairs {
        let (i, j) = (six.index(one), six.index(other));
        let (a, b) = (six.drawn(i).clone(), six.drawn(j).clone());
        (*six.drawn(i), *six.drawn(j)) = (b.clone(), a.clone());
        let agreement = six.agreement();
        assert!(!agreement.ok(), "{one} and {other}");
        let apart = |k: usize| agreement.compared[k].difference.unwrap().ratio > 1.0;
        assert!(apart(i) && apart(j));
        (*six.drawn(i), *six.drawn(j)) = (a, b);
    }
    assert!(six.agreement().ok());
}

#[test]
fn an_answer_of_the_wrong_kind_is_noticed() {
    let mut six = both(&common::example("s000-ch3a-1"));
    let index = six.index("omega(3)");
    *six.drawn(index) = Answer::Vector { value: [4.397_03, 0.0], bound: 1.0 };
    assert!(!six.agreement().ok());
}

// --- the wrong assembly --------------------------------------------------------------------------------

/// The same scene with one hint moved to the other assembly.
fn mirrored(stem: &str, name: &str, place: [f64; 2]) -> Scene {
    let mut value: serde_json::Value = serde_json::from_str(&common::example_text(stem)).unwrap();
    value["near"][name] = serde_json::json!(place);
    common::read(&value.to_string())
}

#[test]
fn the_wrong_branch_is_named_whichever_solver_takes_it() {
    // Problem 3-1 with D to the right of C; the table of problem 4-2, root 2 for root 1.
    let cases = [("s000-ch3a-1", "D", [74.0, 37.0], "D"), ("s000-ch4-2-30-root1", "C", [554.0, 357.0], "C")];
    for (stem, hint, place, named) in cases {
        let (right, wrong) = (both(&common::example(stem)), both(&mirrored(stem, hint, place)));
        assert!(right.agreement().ok() && wrong.agreement().ok(), "{stem}: each branch is sound by itself");
        let drawn_wrong = agreement(&right.scene, &wrong.solved, &right.state);
        let solved_wrong = agreement(&right.scene, &right.solved, &wrong.state);
        for agreement in [drawn_wrong, solved_wrong] {
            assert!(!agreement.ok());
            assert_eq!(
                agreement.elsewhere.as_ref().map(|e| e.name.clone()),
                Some(format!("x({named})")),
                "{stem} {hint}"
            );
        }
    }
}

/// A transmission angle is the same in both assemblies of a four-bar: only the pose tells.
#[test]
fn the_wrong_branch_is_named_even_where_the_numbers_agree() {
    let asking = |root: &str| {
        let text = common::example_text(&format!("s000-ch4-2-30-{root}"));
        let mut value: serde_json::Value = serde_json::from_str(&text).unwrap();
        value["find"] = serde_json::json!(["transmission(3/4)"]);
        both(&common::read(&value.to_string()))
    };
    let (first, second) = (asking("root1"), asking("root2"));
    let agreement = agreement(&first.scene, &first.solved, &second.state);
    assert!(agreement.worst_ratio() <= 1.0, "the angle is the same");
    assert_eq!(agreement.elsewhere.as_ref().map(|e| e.name.as_str()), Some("x(C)"));
    assert!(!agreement.ok());
}

// --- errors of the analytic solver ---------------------------------------------------------------------

/// Solves analytically a mechanism that differs from the drawn one.
fn with_planted(stem: &str, plant: impl Fn(&mut linkgram::mechanism::Mechanism)) -> Agreement {
    let truth = both(&common::example(stem));
    assert!(truth.agreement().ok());
    let mut other = truth.scene.clone();
    plant(&mut other.mechanism);
    agreement(&truth.scene, &truth.solved, &solve::solve_analytically(&other))
}

/// Names whose two numbers differ by more than their bounds.
fn apart(agreement: &Agreement) -> Vec<&str> {
    assert!(!agreement.ok());
    let far = agreement.compared.iter().filter(|c| c.difference.is_some_and(|d| d.ratio > 1.0));
    far.map(|c| c.asked.name.as_str()).collect()
}

#[test]
fn a_motion_with_its_sign_flipped_is_noticed() {
    let agreement = with_planted("s000-ch3a-1", |m| {
        if let Input::Angle { omega, .. } = &mut m.inputs[0] {
            omega.value = -omega.value;
        }
    });
    let apart = apart(&agreement);
    for name in ["v(A)", "v(B)", "v(D)", "omega(3)", "omega(4)", "omega(5)"] {
        assert!(apart.contains(&name), "{name}");
    }
    // Accelerations of a uniform crank do not change when it is reversed.
    for name in ["a(A)", "a(D)", "alpha(3)"] {
        assert!(!apart.contains(&name), "{name}");
    }
}

#[test]
fn an_omitted_tangential_part_of_the_input_is_noticed() {
    let agreement = with_planted("s000-ch4-2-30-root1", |m| {
        if let Input::Angle { alpha, .. } = &mut m.inputs[0] {
            alpha.value = 0.0;
        }
    });
    let apart = apart(&agreement);
    for name in ["alpha(4)", "alpha(3)", "a(B)", "a(C)"] {
        assert!(apart.contains(&name), "{name}");
    }
    assert!(!apart.contains(&"omega(3)"));
}

#[test]
fn omitted_normal_parts_are_noticed() {
    // Only accelerations are asked, so that ω = 0 under the same α is a motion without normal parts.
    let text = common::example_text("s000-ch4-2-30-root1");
    let mut value: serde_json::Value = serde_json::from_str(&text).unwrap();
    value["find"] = serde_json::json!(["a(B)", "a(C)", "alpha(3)", "alpha(4)"]);
    let truth = both(&common::read(&value.to_string()));
    assert!(truth.agreement().ok());
    let mut other = truth.scene.clone();
    if let Input::Angle { omega, .. } = &mut other.mechanism.inputs[0] {
        omega.value = 0.0;
    }
    let agreement = agreement(&truth.scene, &truth.solved, &solve::solve_analytically(&other));
    assert_eq!(apart(&agreement), ["a(B)", "a(C)", "alpha(3)", "alpha(4)"]);
}

#[test]
fn every_given_number_that_is_off_by_a_billionth_is_noticed() {
    let truth = both(&common::example("s000-ch3a-1"));
    let mut noticed = 0;
    let count = common::givens::count(&truth.scene.mechanism);
    for index in 0..count {
        let mut other = truth.scene.clone();
        let (mechanism, before) =
            common::givens::with_changed(&truth.scene.mechanism, index, |x| x * (1.0 + 1e-9));
        other.mechanism = mechanism;
        if before == 0.0 {
            continue;
        }
        let agreement = agreement(&truth.scene, &truth.solved, &solve::solve_analytically(&other));
        assert!(!agreement.ok(), "number {index} ({before})");
        noticed += 1;
    }
    assert!(noticed >= 12, "{noticed} of {count}");
}

#[test]
fn a_refusal_of_one_solver_is_noticed() {
    let agreement = with_planted("s000-ch3a-1", |m| {
        for link in &mut m.links {
            if let linkgram::mechanism::Form::Length(length) = &mut link.form {
                length.value *= 0.1;
            }
        }
    });
    assert!(!agreement.ok());
    assert!(agreement.refused.is_some());
}

/// The same solution with the numbers of a drawing that departs from the right one; their bounds stay.
fn drawn_with(both: &mut Both, departure: Departure) {
    let Solved { structure, plan, scales, .. } = &both.solved;
    let manner = (&[departure][..], &Searched::default());
    let sketch = sketch(&both.scene.mechanism, structure, plan, *scales, manner, None).unwrap();
    for (index, numbers) in sketch.numbers.iter().enumerate() {
        match (both.drawn(index), numbers.as_deref()) {
            (Answer::Scalar { value, .. }, Some([number])) => *value = *number,
            (Answer::Vector { value, .. }, Some([x, y])) => *value = [*x, *y],
            _ => {}
        }
    }
}

/// In public scenes of forces: inertia and weights with the other sign, inertia at the other side or none, weights as masses, the other tangent, the lean to the other side, guides that press aside, and part of the loads left out. Whatever
/// is another drawing is noticed.
#[test]
fn departures_of_forces_are_noticed() {
    let stems =
        ["s000-ch5-1", "s000-ch5-2", "s000-ch5-16", "s000-ch5-20", "s000-ch5-21", "friction-slider-crank"];
    let stems = stems.map(|stem| format!("examples/forces/{stem}"));
    let heavy = ["cylinder-offset-three-links", "rough-pin-of-heavy-block"];
    let stems = stems.into_iter().chain(heavy.map(|stem| format!("tests/derived/{stem}")));
    let mut noticed = std::collections::BTreeMap::new();
    for stem in stems {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("{stem}.json"));
        let text = std::fs::read_to_string(path).unwrap();
        let right = || both(&linkgram::scene::read(&text, &stem).unwrap());
        let truth = right();
        assert!(truth.agreement().ok(), "{stem}");
        let m = &truth.scene.mechanism;
        let links = (0..m.links.len()).map(linkgram::mechanism::LinkId);
        let mut departures: Vec<(&str, Departure)> = Vec::new();
        for link in links.map(Some).chain([None]) {
            departures.extend([
                ("Fin", Departure::InertiaForce { link, twist: Twist::scaled(-1.0) }),
                ("no Fin", Departure::InertiaForce { link, twist: Twist::scaled(0.0) }),
                ("Tin", Departure::InertiaTorque { link, factor: -1.0 }),
                ("side of h", Departure::Offset { link, factor: -1.0 }),
                ("weight as mass", Departure::Weight { link, factor: 9.81 }),
                ("weight up", Departure::Weight { link, factor: -1.0 }),
            ]);
        }
        for pin in &m.forces.friction.pins {
            departures.push(("tangent", Departure::FrictionCircle { pin: pin.pin, factor: -1.0 }));
        }
        for slide in &m.forces.friction.slides {
            departures.push(("lean", Departure::FrictionAngle { slide: slide.slide, factor: -1.0 }));
        }
        for slide in 0..m.slides.len() {
            departures.push(("guide", Departure::GuideForce { slide, along: 1.0 }));
        }
        let before: Vec<Answer> =
            truth.solved.solution.construction.answers.iter().map(|reading| reading.answer.clone()).collect();
        for (what, departure) in departures {
            let mut other = right();
            drawn_with(&mut other, departure);
            let after = &other.solved.solution.construction.answers;
            let moved = before.iter().zip(after).any(|(before, after)| match (before, &after.answer) {
                (Answer::Scalar { value: a, .. }, Answer::Scalar { value: b, .. }) => {
                    (a - b).abs() > 1e-6 * a.abs()
                }
                (Answer::Vector { value: [ax, ay], .. }, Answer::Vector { value: [bx, by], .. }) => {
                    libm::hypot(ax - bx, ay - by) > 1e-6 * libm::hypot(*ax, *ay)
                }
                _ => false,
            });
            if moved {
                assert!(!other.agreement().ok(), "{stem}: {what} {departure:?} is not noticed");
                *noticed.entry(what).or_insert(0) += 1;
            }
        }
    }
    println!("{noticed:?}");
    let wanted =
        ["Fin", "no Fin", "Tin", "side of h", "weight as mass", "weight up", "tangent", "lean", "guide"];
    for what in wanted {
        assert!(noticed.contains_key(what), "{what}: {noticed:?}");
    }
}

/// The angle of pressure to the other side, in the independent solver.
#[test]
fn teeth_that_pull_together_are_noticed() {
    let told = with_planted("forces/planetary-gear", |mechanism| {
        for (_, angle) in &mut mechanism.forces.pressures {
            angle.value = -angle.value;
        }
    });
    assert!(!apart(&told).is_empty());
}
