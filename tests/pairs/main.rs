//! Random mechanisms with every kind of pair and group, and with several inputs: both solvers agree, and what
//! they say obeys the laws.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

pub(crate) mod builder;

use std::f64::consts::PI;

use linkgram::check::agreement;
use linkgram::graphical::construction::Label;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::sheet::scale;
use linkgram::solve::{solve, solve_analytically};
use proptest::prelude::*;
use serde_json::{Value, json};

use builder::{Contact, Made, P2, apart, build, dot, left, minus, plan, plus, size};

/// Answers of one solver by name.
#[derive(Debug, Clone)]
struct Answers(Vec<(String, Answer)>);

impl Answers {
    fn get(&self, name: &str) -> &Answer {
        &self.0.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("{name} was not asked")).1
    }

    fn vector(&self, name: &str) -> Option<(P2, f64)> {
        match self.get(name) {
            Answer::Vector { value, bound } => Some((*value, *bound)),
            _ => None,
        }
    }

    fn scalar(&self, name: &str) -> Option<(f64, f64)> {
        match self.get(name) {
            Answer::Scalar { value, bound } => Some((*value, *bound)),
            _ => None,
        }
    }
}

fn read(value: &Value) -> Scene {
    scene::read(&value.to_string(), "random").unwrap_or_else(|error| panic!("{error}\n{value}"))
}

/// Both answers, after they were found to agree; `None` where the position is too singular to say anything.
fn answers(value: &Value) -> Result<Option<[Answers; 2]>, TestCaseError> {
    let scene = read(value);
    let analytic = solve_analytically(&scene);
    let solved = match solve(&scene, Extent::Asked, scale::for_scene) {
        Ok(solved) => solved,
        Err(error) => {
            prop_assert!(analytic.is_err(), "graphical refuses, analytic does not: {error}\n{value}");
            return Ok(None);
        }
    };
    let agreement = agreement(&scene, &solved, &analytic);
    let worst = agreement
        .compared
        .iter()
        .max_by(|a, b| ratio(a).total_cmp(&ratio(b)))
        .map(|c| format!("{}: {:?} against {:?}", c.asked.name, c.graphical.answer, c.analytic));
    prop_assert!(agreement.ok(), "{:?} {:?} {worst:?}\n{value}", agreement.elsewhere, agreement.refused);
    if agreement.compared.iter().any(|c| c.indeterminate().is_some()) {
        return Ok(None);
    }
    let name = |index: usize| scene.mechanism.asked[index].name.clone();
    let drawn = agreement.compared.iter().enumerate().map(|(i, c)| (name(i), c.graphical.answer.clone()));
    let solved = agreement.compared.iter().enumerate().map(|(i, c)| (name(i), c.analytic.clone()));
    Ok(Some([Answers(drawn.collect()), Answers(solved.collect())]))
}

fn ratio(compared: &linkgram::check::Compared) -> f64 {
    compared.difference.map_or(0.0, |d| d.ratio)
}

/// Two vectors agree within their bounds and a rounding of the comparison itself.
fn close(name: &str, a: (P2, f64), b: (P2, f64)) -> Result<(), TestCaseError> {
    let rounding = 4.0 * f64::EPSILON * (size(a.0) + size(b.0));
    prop_assert!(apart(a.0, b.0) <= a.1 + b.1 + rounding, "{name}: {a:?} against {b:?}");
    Ok(())
}

/// Applies a map to every answer of one scene and compares with the answers of another.
fn same_after(
    before: &Answers,
    after: &Answers,
    vector: impl Fn(&str, P2) -> P2,
    scalar: impl Fn(&str, f64) -> f64,
    factor: impl Fn(&str) -> f64,
) -> Result<(), TestCaseError> {
    for (name, answer) in &before.0 {
        match answer {
            Answer::Vector { value, bound } => {
                let after = after.vector(name);
                prop_assert!(after.is_some(), "{name} is gone");
                let Some(after) = after else { continue };
                close(name, (vector(name, *value), *bound * factor(name)), after)?;
            }
            Answer::Scalar { value, bound } => {
                let after = after.scalar(name);
                prop_assert!(after.is_some(), "{name} is gone");
                let Some(after) = after else { continue };
                let mapped = scalar(name, *value);
                prop_assert!(
                    (mapped - after.0).abs()
                        <= bound * factor(name) + after.1 + 4.0 * f64::EPSILON * mapped.abs(),
                    "{name}: {mapped} against {after:?}"
                );
            }
            _ => {}
        }
    }
    Ok(())
}

fn is_velocity(name: &str) -> bool {
    ["v(", "omega(", "slip("].iter().any(|head| name.starts_with(head))
}

/// Walks over the lengths, points and angles of a scene.
fn transformed(
    value: &Value,
    point_of_frame: &dyn Fn(P2) -> P2,
    own_point: &dyn Fn(P2) -> P2,
    length: &dyn Fn(f64) -> f64,
    offset: &dyn Fn(f64) -> f64,
    frame_angle: &dyn Fn(f64) -> f64,
    own_angle: &dyn Fn(f64) -> f64,
) -> Value {
    let mut value = value.clone();
    let pair = |v: &Value| -> P2 { [v[0].as_f64().unwrap(), v[1].as_f64().unwrap()] };
    for key in ["fixed", "near", "placed"] {
        for (_, at) in value[key].as_object_mut().unwrap() {
            *at = json!(point_of_frame(pair(at)));
        }
    }
    let mut as_in_the_world: Vec<Value> = vec![json!(1)];
    for (number, link) in value["links"].as_object_mut().unwrap() {
        // The axes of placed links are the world's.
        if link.as_object().unwrap().len() == 1 && link["joins"].as_array().unwrap().len() > 1 {
            as_in_the_world.push(json!(number.parse::<u32>().unwrap()));
        }
        if let Some(l) = link.get("length").and_then(Value::as_f64) {
            link["length"] = json!(length(l));
        }
        if let Some(shape) = link.get_mut("shape").and_then(Value::as_object_mut) {
            for (_, at) in shape {
                *at = json!(own_point(pair(at)));
            }
        }
    }
    let wheels: Vec<Value> = value["links"]
        .as_object()
        .unwrap()
        .iter()
        .filter(|(_, link)| link["joins"].as_array().unwrap().len() == 1)
        .map(|(number, _)| json!(number.parse::<u32>().unwrap()))
        .collect();
    let guide = |on: &mut Value| {
        let fixed = as_in_the_world.contains(&on["link"]);
        for key in ["through", "centre"] {
            if on.get(key).is_some_and(Value::is_array) {
                let at = pair(&on[key]);
                // A wheel stands upright wherever its centre is.
                on[key] = json!(if fixed {
                    point_of_frame(at)
                } else if wheels.contains(&on["link"]) {
                    minus(point_of_frame(at), point_of_frame([0.0, 0.0]))
                } else {
                    own_point(at)
                });
            }
        }
        for (key, map) in [("radius", length), ("offset", offset), ("turned", own_angle)] {
            if let Some(x) = on.get(key).and_then(Value::as_f64) {
                on[key] = json!(map(x));
            }
        }
        if let Some(x) = on.get("angle").and_then(Value::as_f64) {
            let upright = fixed || wheels.contains(&on["link"]);
            on["angle"] = json!(if upright { frame_angle(x) } else { own_angle(x) });
        }
    };
    for slide in value["slides"].as_array_mut().unwrap() {
        if let Some(turned) = slide.get("turned").and_then(Value::as_f64) {
            slide["turned"] = json!(own_angle(turned));
        }
        guide(&mut slide["on"]);
    }
    for roll in value["rolls"].as_array_mut().unwrap() {
        if roll.get("line").is_some() {
            guide(&mut roll["line"]);
        }
        if let Some(radius) = roll.get("radius").and_then(Value::as_f64) {
            roll["radius"] = json!(length(radius));
        }
        for radius in roll.get_mut("radii").and_then(Value::as_array_mut).into_iter().flatten() {
            *radius = json!(length(radius.as_f64().unwrap()));
        }
    }
    for input in value["inputs"].as_array_mut().unwrap() {
        if let Some(angle) = input.get("angle").and_then(Value::as_f64) {
            input["angle"] = json!(frame_angle(angle));
        }
        for key in ["at", "velocity", "acceleration"] {
            if let Some(x) = input.get(key).and_then(Value::as_f64) {
                input[key] = json!(length(x));
            }
        }
    }
    value
}

/// The rates of all inputs, each multiplied.
fn inputs_times(value: &mut Value, factors: &[(&str, f64)]) {
    for input in value["inputs"].as_array_mut().unwrap() {
        for (key, factor) in factors {
            if let Some(x) = input.get(*key).and_then(Value::as_f64) {
                input[*key] = json!(factor * x);
            }
        }
    }
}

/// Velocity and acceleration of the point of a body that lies at a place, with their bounds.
fn carried(made: &Made, answers: &Answers, body: u32, at: P2) -> [(P2, f64); 2] {
    let still = [([0.0; 2], 0.0); 2];
    if body == 1 {
        return still;
    }
    let (_, name, place) = made.holds.iter().find(|(number, ..)| *number == body).unwrap();
    let moves = !made.scene["fixed"].as_object().unwrap().contains_key(name);
    let [v, a] = if moves {
        ["v", "a"].map(|what| answers.vector(&format!("{what}({name})")).unwrap())
    } else {
        still
    };
    let [omega, alpha] = ["omega", "alpha"].map(|what| answers.scalar(&format!("{what}({body})")).unwrap());
    let arm = minus(at, *place);
    let velocity = plus(v.0, omega.0, left(arm));
    let acceleration = plus(plus(a.0, alpha.0, left(arm)), -omega.0 * omega.0, arm);
    let reach = size(arm);
    let square = (2.0 * omega.0.abs() + omega.1) * omega.1;
    [(velocity, v.1 + omega.1 * reach), (acceleration, a.1 + (alpha.1 + square) * reach)]
}

fn same(x: f64) -> f64 {
    x
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 250, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn both_solvers_agree(plan in plan(4)) {
        if let Some(made) = build(&plan) {
            answers(&made.scene)?;
        }
    }

    /// Every vector runs from the image that it names to the image that it names.
    #[test]
    fn polygons_close(plan in plan(3)) {
        let Some(made) = build(&plan) else { return Ok(()) };
        let Ok(solved) = solve(&read(&made.scene), Extent::Asked, scale::for_scene) else { return Ok(()) };
        let construction = &solved.solution.construction;
        for polygon in &construction.diagrams {
            for vector in &polygon.vectors {
                for (label, at) in [(vector.tail, vector.from), (vector.head, vector.to)] {
                    let stands = label == Label::Pole && at == [0.0; 2]
                        || polygon.images.iter().any(|i| i.label == label && i.at == at);
                    prop_assert!(stands, "{:?} of {:?} is at no {:?}\n{}", vector.kind, vector.quantity, label, made.scene);
                }
            }
        }
    }

    /// The contact points of rolling bodies have one velocity, and their accelerations differ only along
    /// the common normal.
    #[test]
    fn rolling_does_not_slip(plan in plan(4)) {
        let Some(made) = build(&plan) else { return Ok(()) };
        if made.contacts.is_empty() {
            return Ok(());
        }
        let Some(both) = answers(&made.scene)? else { return Ok(()) };
        for answers in &both {
            for Contact { bodies, at, normal } in &made.contacts {
                let [one, other] = bodies.map(|body| carried(&made, answers, body, *at));
                // The builder's places are rounded.
                let slack = |a: (P2, f64), b: (P2, f64)| a.1 + b.1 + 1e-9 * (1.0 + size(a.0) + size(b.0));
                let slip = apart(one[0].0, other[0].0);
                prop_assert!(slip <= slack(one[0], other[0]), "{bodies:?} slip by {slip}");
                let along = dot(minus(one[1].0, other[1].0), left(*normal)).abs();
                prop_assert!(along <= slack(one[1], other[1]), "{bodies:?} creep by {along}");
            }
        }
    }

    #[test]
    fn coincident_points_add_up(plan in plan(3)) {
        let Some(Made { scene, rides, .. }) = build(&plan) else { return Ok(()) };
        let Some(both) = answers(&scene)? else { return Ok(()) };
        for answers in &both {
            for (pin, link, arc) in &rides {
                let of = |name: &str| answers.vector(name).unwrap();
                let slip = of(&format!("slip({pin}/{link})"));
                let coriolis = of(&format!("coriolis({pin}/{link})"));
                let aslip = of(&format!("aslip({pin}/{link})"));
                let (v, under) = (of(&format!("v({pin})")), of(&format!("v({pin}@{link})")));
                close("v = v@ + slip", v, (plus(under.0, 1.0, slip.0), under.1 + slip.1))?;
                let (a, under) = (of(&format!("a({pin})")), of(&format!("a({pin}@{link})")));
                let sum = plus(plus(under.0, 1.0, aslip.0), 1.0, coriolis.0);
                close("a = a@ + aslip + coriolis", a, (sum, under.1 + aslip.1 + coriolis.1))?;
                let omega = if *link == 1 { (0.0, 0.0) } else { answers.scalar(&format!("omega({link})")).unwrap() };
                if *link == 1 {
                    prop_assert!(size(coriolis.0) <= coriolis.1, "Coriolis on a fixed guide: {coriolis:?}");
                }
                let expected = left(slip.0).map(|x| 2.0 * omega.0 * x);
                let bound = 2.0 * (omega.0.abs() * slip.1 + omega.1 * (size(slip.0) + slip.1));
                close("coriolis = 2 omega x slip", coriolis, (expected, bound))?;
                let across = dot(coriolis.0, slip.0).abs();
                let allowed = size(slip.0) * coriolis.1 + size(coriolis.0) * slip.1 + coriolis.1 * slip.1;
                prop_assert!(across <= allowed + 1e-15 * size(slip.0) * size(coriolis.0), "{coriolis:?} is not square to {slip:?}");
                if *arc {
                    let (n, t) = (of(&format!("aslipn({pin}/{link})")), of(&format!("aslipt({pin}/{link})")));
                    close("aslip = aslipn + aslipt", aslip, (plus(n.0, 1.0, t.0), n.1 + t.1))?;
                }
            }
        }
    }

    #[test]
    fn time_reversed(plan in plan(3)) {
        let Some(Made { scene, .. }) = build(&plan) else { return Ok(()) };
        let mut back = scene.clone();
        inputs_times(&mut back, &[("omega", -1.0), ("velocity", -1.0)]);
        let (Some(there), Some(back)) = (answers(&scene)?, answers(&back)?) else { return Ok(()) };
        for (there, back) in there.iter().zip(&back) {
            let sign = |name: &str| if is_velocity(name) { -1.0 } else { 1.0 };
            same_after(there, back, |n, v| v.map(|x| sign(n) * x), |n, x| sign(n) * x, |_| 1.0)?;
        }
    }

    #[test]
    fn mirrored(plan in plan(3)) {
        let Some(Made { scene, .. }) = build(&plan) else { return Ok(()) };
        let flip = |p: P2| [p[0], -p[1]];
        let minus = |x: f64| -x;
        let mut image = transformed(&scene, &flip, &flip, &same, &minus, &minus, &minus);
        inputs_times(&mut image, &[("omega", -1.0), ("alpha", -1.0)]);
        let (Some(here), Some(there)) = (answers(&scene)?, answers(&image)?) else { return Ok(()) };
        for (here, there) in here.iter().zip(&there) {
            same_after(here, there, |_, v| flip(v), |_, x| -x, |_| 1.0)?;
        }
    }

    #[test]
    fn scaled(plan in plan(3), exponent in -12..12_i32) {
        let Some(Made { scene, .. }) = build(&plan) else { return Ok(()) };
        let k = 2.0_f64.powi(exponent);
        let times = |x: f64| k * x;
        let grow = |p: P2| p.map(|x| k * x);
        let large = transformed(&scene, &grow, &grow, &times, &times, &same, &same);
        let (Some(here), Some(there)) = (answers(&scene)?, answers(&large)?) else { return Ok(()) };
        for (here, there) in here.iter().zip(&there) {
            let is_length = |name: &str| !name.starts_with("omega") && !name.starts_with("alpha");
            let factor = |name: &str| if is_length(name) { k } else { 1.0 };
            same_after(here, there, |_, v| grow(v), |_, x| x, factor)?;
        }
    }

    #[test]
    fn turned_by_a_quarter(plan in plan(3)) {
        let Some(Made { scene, .. }) = build(&plan) else { return Ok(()) };
        let quarter = |x: f64| x + PI / 2.0;
        let own = |p: P2| p;
        let image = transformed(&scene, &left, &own, &same, &same, &quarter, &same);
        let (Some(here), Some(there)) = (answers(&scene)?, answers(&image)?) else { return Ok(()) };
        for (here, there) in here.iter().zip(&there) {
            // The angles were turned with a rounding that the image's own bounds do not know.
            let rounding = 1e-9;
            let loose = Answers(here.0.iter().map(|(n, a)| (n.clone(), widen(a, rounding))).collect());
            same_after(&loose, there, |_, v| left(v), |_, x| x, |_| 1.0)?;
        }
    }
}

fn widen(answer: &Answer, part: f64) -> Answer {
    match answer {
        Answer::Vector { value, bound } => {
            Answer::Vector { value: *value, bound: bound + part * (1.0 + size(*value)) }
        }
        Answer::Scalar { value, bound } => {
            Answer::Scalar { value: *value, bound: bound + part * (1.0 + value.abs()) }
        }
        other => other.clone(),
    }
}

/// The laws above say nothing about what the generator never builds.
#[test]
fn the_generator_reaches_every_group_and_most_of_it_is_solved() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;
    let mut runner = TestRunner::deterministic();
    let (mut built, mut solved) = (0, 0);
    let mut kinds: Vec<String> = Vec::new();
    for _ in 0..600 {
        let plan = plan(4).new_tree(&mut runner).unwrap().current();
        let Some(Made { scene, rides, .. }) = build(&plan) else { continue };
        built += 1;
        if answers(&scene).unwrap().is_none() {
            continue;
        }
        solved += 1;
        let structure = linkgram::mechanism::structure::Structure::of(&read(&scene).mechanism).unwrap();
        kinds.extend(structure.groups.iter().map(|g| g.kind.to_string()));
        kinds.extend(rides.iter().map(|(_, link, arc)| {
            let moving = if *link == 1 { "fixed" } else { "moving" };
            format!("{moving} {}", if *arc { "arc" } else { "line" })
        }));
    }
    assert!(solved * 10 > built * 7, "{solved} of {built}");
    let wanted = [
        "RRR",
        "RRP",
        "RPR",
        "PRP",
        "PPR",
        "RPP",
        "wheel",
        "rack",
        "driven bar",
        "driven wheel",
        "driven slide",
        "rod with a rolling wheel",
        "group of higher class",
        "fixed arc",
        "fixed line",
        "moving arc",
        "moving line",
    ];
    for kind in wanted {
        let count = kinds.iter().filter(|k| *k == kind).count();
        assert!(count > 20, "{kind}: {count}");
    }
}
