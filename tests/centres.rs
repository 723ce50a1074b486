//! Instant centres: the circle diagram against the other solver and against the laws of Kennedy.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use crate::common;

use std::collections::BTreeMap;

use crate::common::{example_paths, read};
use linkgram::check::agreement;
use linkgram::graphical;
use linkgram::graphical::construction::CentrePlace;
use linkgram::mechanism::LinkId;
use linkgram::mechanism::quantity::{Answer, Order, Quantity};
use linkgram::plan::{Extent, Plan};
use linkgram::scene::Scene;
use linkgram::sheet::overlap::overlaps;
use linkgram::sheet::{self, Language, scale};
use linkgram::solve::{Solved, solve, solve_analytically};
use serde_json::{Value, json};

/// Every scene that can be solved: examples, errata, pairs, catalogue.
fn all_scenes() -> Vec<(String, String)> {
    let mut all: Vec<(String, String)> = example_paths()
        .into_iter()
        .filter(|path| !path.to_str().unwrap().contains("refusals"))
        .map(|path| (path.display().to_string(), std::fs::read_to_string(&path).unwrap()))
        .collect();
    all.extend(linkgram::catalogue::KINDS.iter().map(|kind| (kind.name.to_owned(), kind.scene.to_owned())));
    assert!(all.len() > 100, "examples and catalogue are there");
    all
}

/// The same mechanism, asked for all its centres and all ω.
fn asking_for_centres(text: &str) -> Scene {
    let mut scene: Value = serde_json::from_str(text).unwrap();
    let numbers: Vec<u32> = read(text).mechanism.links.iter().map(|l| l.number).collect();
    let mut find = Vec::new();
    for (n, i) in numbers.iter().enumerate() {
        find.extend(numbers[n + 1..].iter().map(|j| json!(format!("I({i},{j})"))));
    }
    find.extend(numbers[1..].iter().map(|i| json!(format!("omega({i})"))));
    let map = scene.as_object_mut().unwrap();
    map.insert("find".to_owned(), Value::Array(find));
    for key in ["published", "errata", "sheet"] {
        map.remove(key);
    }
    read(&scene.to_string())
}

/// Homogeneous coordinates of a centre, metres, with the radius of uncertainty of a finite one.
#[derive(Debug, Clone, Copy)]
struct Place {
    at: [f64; 3],
    bound: f64,
}

fn places(scene: &Scene, solved: &Solved) -> (BTreeMap<[LinkId; 2], Place>, BTreeMap<LinkId, f64>) {
    let (mut centres, mut rates) = (BTreeMap::new(), BTreeMap::from([(LinkId::FRAME, 0.0)]));
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
        match (asked.quantity, &reading.answer) {
            (Quantity::Centre(i, j), Answer::Vector { value: [x, y], bound }) => {
                centres.insert([i, j], Place { at: [*x, *y, 1.0], bound: *bound });
            }
            (Quantity::Centre(i, j), Answer::AtInfinity { direction: [x, y], bound }) => {
                centres.insert([i, j], Place { at: [*x, *y, 0.0], bound: *bound });
            }
            (Quantity::Omega(l), Answer::Scalar { value, .. }) => {
                rates.insert(l, *value);
            }
            (_, answer) => panic!("{}: {answer:?}", asked.name),
        }
    }
    (centres, rates)
}

/// The determinant of three places, and what their uncertainties make of it.
fn collinear([p, q, r]: [Place; 3]) -> (f64, f64) {
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let norm = |a: [f64; 3]| dot(a, a).sqrt();
    let error = p.bound * norm(cross(q.at, r.at))
        + q.bound * norm(cross(r.at, p.at))
        + r.bound * norm(cross(p.at, q.at));
    // The determinant itself is computed here with rounding.
    let rounding = 8.0 * f64::EPSILON * norm(p.at) * norm(q.at) * norm(r.at);
    (dot(p.at, cross(q.at, r.at)).abs(), 1.001 * error + rounding)
}

#[test]
fn every_centre_of_every_scene_agrees_with_the_other_solver_and_with_kennedy() {
    let mut count = 0;
    for (name, text) in all_scenes() {
        let scene = asking_for_centres(&text);
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap_or_else(|e| panic!("{name}: {e}"));
        let agreement = agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(
            agreement.ok(),
            "{name}: {:?}",
            agreement.compared.iter().find(|c| c.difference.is_none_or(|d| d.ratio > 1.0))
        );
        let (centres, rates) = places(&scene, &solved);
        let links: Vec<LinkId> = rates.keys().copied().collect();
        assert_eq!(centres.len(), links.len() * (links.len() - 1) / 2, "{name}");
        count += centres.len();
        for (n, &i) in links.iter().enumerate() {
            for (m, &j) in links.iter().enumerate().skip(n + 1) {
                for &k in &links[m + 1..] {
                    let triple = [[i, j], [j, k], [i, k]].map(|c| centres[&c]);
                    let (off, bound) = collinear(triple);
                    assert!(off <= bound, "{name}: {i:?} {j:?} {k:?}: {off:e} > {bound:e}");
                }
                // ω_i : ω_j = (1j–ij) : (1i–ij).
                let [one, other, both] =
                    [[LinkId::FRAME, i], [LinkId::FRAME, j], [i, j]].map(|c| centres.get(&c));
                if let (Some(one), Some(other), Some(both)) = (one, other, both)
                    && [one, other, both].iter().all(|p| p.at[2] == 1.0)
                {
                    for axis in [0, 1] {
                        let arm = |p: &Place| both.at[axis] - p.at[axis];
                        let off = rates[&i] * arm(one) - rates[&j] * arm(other);
                        let size = rates[&i].abs() * (one.bound + both.bound)
                            + rates[&j].abs() * (other.bound + both.bound);
                        let speed = rates[&i].abs() * arm(one).abs() + rates[&j].abs() * arm(other).abs();
                        assert!(off.abs() <= 1.001 * size + 1e-9 * speed, "{name}: {i:?} {j:?}: {off:e}");
                    }
                }
            }
        }
    }
    assert!(count > 1000, "{count} centres were compared");
}

#[test]
fn without_a_primary_chord_what_hangs_on_it_is_unreachable() {
    let scene = asking_for_centres(&common::example_text("s000-ch3b-1"));
    let link = |n: u32| scene.mechanism.link_numbered(n).unwrap();
    let structure = linkgram::mechanism::structure::Structure::of(&scene.mechanism).unwrap();
    let mut plan = Plan::new(&scene.mechanism, &structure, Extent::Asked);
    plan.centres.barred.insert([link(5), link(6)]);
    let scales = scale::for_scene(&scene, graphical::extents(&scene.mechanism, &structure, &plan).unwrap());
    let solution = graphical::construct(&scene.mechanism, &structure, &plan, scales).unwrap();
    let circle = solution.construction.circle.unwrap();
    let found = |i, j| circle.centre([link(i), link(j)]).is_some();
    // Rod and slider hang together by nothing else: no triangle leads to the centres of the one half with the rod or
    // to those of the slider's outer half.
    for (i, j) in [(1, 5), (2, 5), (3, 5), (5, 6)] {
        assert!(!found(i, j), "({i}{j}) was found without (56)");
        assert!(circle.stalled.contains(&[link(i), link(j)]));
    }
    for (i, j) in [(1, 3), (2, 4), (1, 6), (4, 5)] {
        assert!(found(i, j), "({i}{j}) does not need (56)");
    }
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solution.construction.answers) {
        if let Quantity::Centre(i, j) = asked.quantity {
            let refused = matches!(reading.answer, Answer::Indeterminate(_));
            assert_eq!(refused, circle.centre([i, j]).is_none(), "{}", asked.name);
        }
    }
}

#[test]
fn only_the_chords_on_the_way_are_built() {
    // s000-ch3b 3-5: the direct method to I26 takes (24) and (46), and nothing else.
    let mut scene = asking_for_centres(&common::example_text("s000-ch3b-1"));
    let link = |n: u32| scene.mechanism.link_numbered(n).unwrap();
    let (two, six) = (link(2), link(6));
    scene.mechanism.asked.retain(|a| a.quantity == Quantity::Centre(two, six));
    let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
    let circle = solved.solution.construction.circle.unwrap();
    let built = circle.centres.iter().filter(|c| !c.found.is_primary()).count();
    assert_eq!(built, 3, "{:?}", circle.centres);
    assert!(solved.plan.steps(Order::Velocity).is_empty());
}

/// Crank 2, coupler 13, rocker 7 on a frame of 12: at 90° crank and rocker are parallel (5-12-13) and (13) lies at
/// infinity.
fn trapezoid(degrees: f64) -> Scene {
    read(
        &json!({
            "fixed": { "O2": [0, 0], "O4": [12, 0] },
            "links": { "2": { "joins": ["O2", "A"], "length": 2 }, "3": { "joins": ["A", "B"], "length": 13 },
                       "4": { "joins": ["O4", "B"], "length": 7 } },
            "near": { "B": [12, 7] },
            "input": { "link": 2, "angle": degrees, "omega": 1 },
            "find": ["I(1,3)", "I(2,4)"],
        })
        .to_string(),
    )
}

#[test]
fn a_centre_passes_through_infinity() {
    let mut sides = Vec::new();
    for step in
        [10.0, 1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 0.0, -1e-10, -1e-8, -1e-6, -1e-4, -1e-2, -1.0, -10.0]
    {
        let scene = trapezoid(90.0 + step);
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        let agreement = agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(agreement.ok(), "{step}: {:?}", agreement.compared);
        let circle = solved.solution.construction.circle.as_ref().unwrap();
        let coupler = circle.centre([LinkId::FRAME, LinkId(2)]).unwrap();
        match coupler.place {
            CentrePlace::At([_, y]) => {
                assert!(step != 0.0);
                sides.push(y.signum());
            }
            CentrePlace::Toward([x, _]) => {
                assert_eq!(step, 0.0);
                assert!(x.abs() < 1e-12, "parallel to the cranks");
            }
        }
    }
    // It leaves upward and comes back from below, or the other way round.
    assert_eq!(sides.iter().filter(|s| **s == sides[0]).count(), 7, "{sides:?}");
}

#[test]
fn the_figures_of_every_scene_are_clear() {
    let mut bad = Vec::new();
    for (name, text) in all_scenes() {
        let mut scene = read(&text);
        scene.mechanism.asked.truncate(1);
        let solved = solve(&scene, Extent::AllCentres, scale::for_scene).unwrap();
        if scene.mechanism.links.len() < 2 {
            // A turning-moment diagram alone: the frame has no centre with another link.
            assert!(solved.solution.construction.circle.is_none(), "{name}");
            continue;
        }
        for figure in ["centres", "circle"] {
            let drawn =
                sheet::single(&scene, &solved.solution.construction, figure, Language::English).unwrap();
            bad.extend(
                overlaps(&drawn).into_iter().map(|touching| format!("{name}, {figure}: {touching:?}")),
            );
        }
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}

/// The same mechanism, asked by one method for every ω and V, or every α and A.
fn asking_by(method: &str, names: [&str; 2], text: &str) -> Scene {
    let mut scene: Value = serde_json::from_str(text).unwrap();
    let whole = read(text);
    let moving = whole.mechanism.links.iter().skip(1).map(|l| format!("{}({})", names[0], l.number));
    let points = (0..whole.mechanism.points.len()).map(linkgram::mechanism::PointId);
    let points = points
        .filter(|p| !whole.mechanism.is_fixed(*p) && !whole.mechanism.point(*p).links.is_empty())
        .map(|p| format!("{}({})", names[1], whole.mechanism.point(p).name));
    let find: Vec<Value> =
        moving.chain(points).map(|name| json!({ "name": name, "method": method })).collect();
    let map = scene.as_object_mut().unwrap();
    map.insert("find".to_owned(), Value::Array(find));
    for key in ["published", "errata", "sheet"] {
        map.remove(key);
    }
    read(&scene.to_string())
}

/// Solves by a method; how many quantities it led to, all of which agree with the other solver.
fn answered(name: &str, scene: &Scene) -> usize {
    let solved = match solve(scene, Extent::Asked, scale::for_scene) {
        Ok(solved) => solved,
        // Several inputs, or a wheel that rolls on a moving body: said, and not answered.
        Err(linkgram::solve::SolveError::Unanswered { .. }) => return 0,
        Err(error) => panic!("{name}: {error}"),
    };
    let agreement = agreement(scene, &solved, &solve_analytically(scene));
    assert!(
        agreement.ok(),
        "{name}: {:?}",
        agreement.compared.iter().find(|c| c.difference.is_some_and(|d| d.ratio > 1.0))
    );
    agreement.compared.iter().filter(|c| c.difference.is_some()).count()
}

#[test]
fn velocities_from_centres_agree_by_every_method() {
    for (method, least) in
        [("centres", 700), ("line-of-centres", 650), ("gauge-line", 500), ("link-to-link", 500)]
    {
        let all: usize = all_scenes()
            .iter()
            .map(|(name, text)| {
                answered(&format!("{name} by {method}"), &asking_by(method, ["omega", "v"], text))
            })
            .sum();
        assert!(all >= least, "{method} led to {all} quantities");
    }
}

#[test]
fn accelerations_fed_with_omega_from_centres_agree() {
    let all: usize = all_scenes()
        .iter()
        .map(|(name, text)| answered(&format!("{name}, fed"), &asking_by("centres", ["alpha", "a"], text)))
        .sum();
    assert!(all >= 700, "{all} accelerations");
}

#[test]
fn a_velocity_has_no_jump_where_its_centre_goes_through_infinity() {
    for method in ["centres", "link-to-link", "gauge-line", "line-of-centres"] {
        let mut last: Option<f64> = None;
        for step in [1e-3, 1e-5, 1e-7, 1e-9, 0.0, -1e-9, -1e-7, -1e-5, -1e-3] {
            let mut scene = trapezoid(90.0 + step);
            scene.mechanism.asked.truncate(1);
            let b = scene.mechanism.point_named("B").unwrap();
            scene.mechanism.asked[0].quantity = Quantity::Velocity(b);
            scene.mechanism.asked[0].method = linkgram::mechanism::quantity::Method::PLAIN
                .into_iter()
                .find(|m| m.name() == method)
                .unwrap();
            let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
            let agreement = agreement(&scene, &solved, &solve_analytically(&scene));
            assert!(agreement.ok(), "{method}, {step}: {:?}", agreement.compared);
            let Answer::Vector { value, .. } = solved.solution.construction.answers[0].answer else {
                panic!(
                    "{method} has no answer at {step}: {:?}",
                    solved.solution.construction.answers[0].answer
                );
            };
            let speed = value[0].hypot(value[1]);
            // Crank and rocker parallel: the coupler translates, and B is as fast as A.
            assert!((speed - 2.0).abs() < 1e-4, "{method}, {step}: {speed}");
            assert!(last.is_none_or(|before| (before - speed).abs() < 1e-4));
            last = Some(speed);
        }
    }
}

/// Two cranks that nothing joins: no triangle of the circle diagram leads to their centre, but their velocities are
/// known. It divides the line of the pivots inversely as the speeds; at equal ones it is at infinity along that line.
#[test]
fn links_that_are_driven_separately_have_a_centre_from_their_velocities() {
    let scene = |first: f64, second: f64| {
        read(&format!(
            r#"{{ "units": {{ "length": "cm" }}, "fixed": {{ "O2": [0, 0], "O5": [40, 30] }},
                 "links": {{ "2": {{ "joins": ["O2", "A"], "length": 15 }}, "5": {{ "joins": ["O5", "C"], "length": 15 }} }},
                 "inputs": [ {{ "link": 2, "angle": 80, "omega": {first} }}, {{ "link": 5, "angle": 60, "omega": {second} }} ],
                 "find": ["I(2,5)", "I(1,2)", "I(1,5)"] }}"#
        ))
    };
    for (first, second) in [
        (10.0, 4.0),
        (10.0, -4.0),
        (10.0, 10.0),
        (0.0, 5.0),
        (5.0, 0.0),
        (1e-12, 5.0),
        (1e-12, 2e-12),
        (1e-12, 1e-12),
    ] {
        let scene = scene(first, second);
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        let agreement = agreement(&scene, &solved, &solve_analytically(&scene));
        assert!(agreement.ok(), "{first}, {second}: {:?}", agreement.compared[0]);
        match &solved.solution.construction.answers[0].answer {
            Answer::Vector { value, .. } => {
                // ω₂ P = ω₅ (P − O5).
                let part = second / (second - first);
                for (found, pivot) in value.iter().zip([0.4, 0.3]) {
                    assert!((found - part * pivot).abs() < 1e-12, "{first}, {second}: {value:?}");
                }
            }
            Answer::AtInfinity { direction: [x, y], .. } => {
                assert_eq!(first, second);
                assert!((x * 0.3 - y * 0.4).abs() < 1e-15, "{x} {y}");
            }
            other => panic!("{first}, {second}: {other:?}"),
        }
    }
    // Nothing moves against the other: there is no centre.
    let still = scene(0.0, 0.0);
    let solved = solve(&still, Extent::Asked, scale::for_scene).unwrap();
    assert!(matches!(solved.solution.construction.answers[0].answer, Answer::Indeterminate(_)));
}

/// A skeleton with its centres is as large as the paper takes it with what is needed of them.
#[test]
fn a_sheet_of_centres_is_no_smaller_than_its_centres_make_it() {
    for (name, least) in [("centres/gear-linkage", 12.0), ("centres/four-bar", 18.0)] {
        let scene = common::example(name);
        let solved = solve(&scene, Extent::WholeSkeleton, scale::for_scene).unwrap();
        let mm = |metres: f64| metres / solved.scales.length();
        // The crank of 40 mm, and on the sheet every centre that is asked for.
        assert!(mm(0.040) >= least, "{name}: the crank is {} mm", mm(0.040));
        let figure =
            sheet::single(&scene, &solved.solution.construction, "centres", Language::English).unwrap();
        let circle = solved.solution.construction.circle.as_ref().unwrap();
        let mut drawn = String::new();
        figure.root.walk(&mut |node| {
            if let sheet::figure::Node::Text(text) = node {
                drawn.extend(text.runs.iter().map(|run| run.text.as_str()));
                drawn.push(' ');
            }
        });
        for centre in &circle.centres {
            let [i, j] = centre.links.map(|link| scene.mechanism.link(link).number);
            assert!(drawn.contains(&format!("({i}{j})")), "{name}: ({i}{j}) in {drawn}");
            assert!(!drawn.contains(&format!("({i}{j})\u{a0}")), "{name}: ({i}{j}) is off the sheet");
        }
    }
}
