//! Other constructions of a force than the usual one: inertia by two masses, Zhukovsky's lever, three forces that meet.
//!
//! The truth of a line of inertia is its moment about the mass centre, −I ε, by kinematics of the test's own; that of an
//! effort is the power of everything else, by closed forms and by the independent solver.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use linkgram::check;
use linkgram::graphical::auxiliary::PointName;
use linkgram::graphical::construction::Reading;
use linkgram::mechanism::quantity::{Answer, Indeterminate, Method};
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::sheet::{self, Language, overlap, scale};
use linkgram::solve::{Settings, Solved, solve, solve_analytically, solve_with};
use serde_json::{Value, json};

use crate::common::{self, cross, minus, norm};
use crate::forces_routes::loaded;

const RADIUS: f64 = 0.05;
const ROD: f64 = 0.2;
const OMEGA: f64 = 30.0;
const EPSILON: f64 = -140.0;

/// A slider-crank whose rod has its mass centre at own coordinates, with a rocker of a fixed pivot as its crank.
fn slider_crank(theta: f64, centre: [f64; 2], find: &Value) -> Value {
    json!({
        "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A", "E"], "sides": [RADIUS, 0.03, 0.06], "turn": "ccw" },
                   "3": { "joins": ["A", "B"], "length": ROD } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0.01], "angle": 0 } } ],
        "near": { "B": [RADIUS * theta.cos() + ROD, 0.01] },
        "input": { "link": 2, "angle": theta.to_degrees(), "omega": OMEGA, "alpha": EPSILON },
        "masses": { "2": { "mass": 1.5, "at": [0.02, 0], "inertia": 0.003 },
                    "3": { "mass": 2, "at": centre, "inertia": 0.012 }, "4": { "mass": 0.8 } },
        "loads": [ { "name": "P", "on": 4, "at": "B", "force": [-120, 35] }, { "name": "M", "on": 3, "torque": 4 } ],
        "find": find
    })
}

/// Places, velocities and accelerations of A and B, and φ, ω and ε of the rod.
struct Motion {
    a: [[f64; 2]; 3],
    b: [[f64; 2]; 3],
    rod: [f64; 3],
}

fn motion(theta: f64) -> Motion {
    let (s, c) = theta.sin_cos();
    let a = [
        [RADIUS * c, RADIUS * s],
        [-RADIUS * OMEGA * s, RADIUS * OMEGA * c],
        [RADIUS * (-EPSILON * s - OMEGA * OMEGA * c), RADIUS * (EPSILON * c - OMEGA * OMEGA * s)],
    ];
    // l sin φ = e − y_A, twice differentiated.
    let phi = ((0.01 - a[0][1]) / ROD).asin();
    let omega = -a[1][1] / (ROD * phi.cos());
    let epsilon = (-a[2][1] + ROD * omega * omega * phi.sin()) / (ROD * phi.cos());
    let r = [ROD * phi.cos(), ROD * phi.sin()];
    let b = moved(a, r, omega, epsilon);
    Motion { a, b, rod: [phi, omega, epsilon] }
}

fn moved(base: [[f64; 2]; 3], r: [f64; 2], omega: f64, epsilon: f64) -> [[f64; 2]; 3] {
    let w2 = omega * omega;
    [
        [base[0][0] + r[0], base[0][1] + r[1]],
        [base[1][0] - omega * r[1], base[1][1] + omega * r[0]],
        [base[2][0] - epsilon * r[1] - w2 * r[0], base[2][1] + epsilon * r[0] - w2 * r[1]],
    ]
}

/// The mass centre of the rod.
fn of_rod(theta: f64, own: [f64; 2]) -> [[f64; 2]; 3] {
    let m = motion(theta);
    let (s, c) = m.rod[0].sin_cos();
    let r = [c * own[0] - s * own[1], s * own[0] + c * own[1]];
    moved(m.a, r, m.rod[1], m.rod[2])
}

fn solved(scene: &Scene) -> Solved {
    let solved = solve(scene, Extent::WholeSkeleton, scale::for_scene).unwrap();
    check::confirm(scene, &solved).unwrap();
    let agreement = check::agreement(scene, &solved, &solve_analytically(scene));
    assert!(agreement.ok(), "{:?} {:?}", agreement.disagreements(), agreement.power);
    solved
}

fn reading(scene: &Scene, solved: &Solved, method: fn(&Method) -> bool) -> Reading {
    let place = scene.mechanism.asked.iter().position(|asked| method(&asked.method)).unwrap();
    solved.solution.construction.answers[place].clone()
}

fn vector(answer: &Answer) -> [f64; 2] {
    match answer {
        Answer::Vector { value, .. } => *value,
        other => panic!("{other:?}"),
    }
}

fn scalar(answer: &Answer) -> f64 {
    match answer {
        Answer::Scalar { value, .. } => *value,
        other => panic!("{other:?}"),
    }
}

fn by_two_masses(method: &Method) -> bool {
    matches!(method, Method::TwoMasses { .. })
}

fn refused(scene: &Scene, method: fn(&Method) -> bool) -> String {
    let solved = solve(scene, Extent::Asked, scale::for_scene);
    match solved {
        Ok(solved) => match reading(scene, &solved, method).answer {
            Answer::Indeterminate(Indeterminate::Undefined { why }) => why,
            other => panic!("{other:?}"),
        },
        Err(why) => why.to_string(),
    }
}

/// −M A_G in a line whose moment about G is −I ε: with the first mass at either pin, and with both at pins.
#[test]
fn the_line_of_two_masses_is_that_of_the_inertia_force() {
    let ways = [json!({ "first": "A" }), json!({ "first": "B" }), json!({ "first": "A", "second": "B" })];
    for step in 0..24 {
        let theta = 0.13 + f64::from(step) * std::f64::consts::TAU / 24.0;
        for (way, points) in ways.iter().enumerate() {
            // Off the rod's line only where the second mass is free.
            let own = if way == 2 { [0.07, 0.0] } else { [0.07, 0.02] };
            let mut find = json!({ "name": "Fin(3)", "method": "two-masses" });
            find.as_object_mut().unwrap().extend(points.as_object().unwrap().clone());
            let scene = common::read(&slider_crank(theta, own, &json!([find])).to_string());
            let solved = solved(&scene);
            let found = reading(&scene, &solved, by_two_masses);
            let [place, _, acceleration] = of_rod(theta, own);
            let force = vector(&found.answer);
            for axis in 0..2 {
                let wanted = -2.0 * acceleration[axis];
                assert!((force[axis] - wanted).abs() < 1e-9 * norm(acceleration), "{force:?} {wanted}");
            }
            let moment = cross(minus(found.through.unwrap(), place), force);
            let wanted = -0.012 * motion(theta).rod[2];
            let room = 1e-9 * (wanted.abs() + norm(force) * norm(minus(found.through.unwrap(), place)));
            assert!((moment - wanted).abs() < room, "{theta} {points}: {moment} is not {wanted}");
        }
    }
}

/// The second mass stands where h₁ h₂ = I/M, in line with the mass centre.
#[test]
fn the_mass_centre_divides_the_two_masses() {
    let find = json!([{ "name": "Fin(3)", "method": "two-masses", "first": "A" }]);
    let scene = common::read(&slider_crank(0.9, [0.07, 0.02], &find).to_string());
    let solved = solved(&scene);
    let construction = &solved.solution.construction;
    let drawing = &construction.auxiliary[0];
    let second = drawing.points.iter().find(|point| point.name == PointName::SecondMass).unwrap().at;
    let second = second.map(|mm| mm * construction.space.metres_per_mm);
    let (a, g) = (motion(0.9).a[0], of_rod(0.9, [0.07, 0.02])[0]);
    let (h1, h2) = (norm(minus(g, a)), norm(minus(second, g)));
    assert!((h1 * h2 - 0.012 / 2.0).abs() < 1e-12, "{h1} {h2}");
    assert!(cross(minus(g, a), minus(second, g)).abs() < 1e-12);
    assert!((norm(minus(second, a)) - h1 - h2).abs() < 1e-12);
}

/// A crank about a fixed pivot: the mass at the pivot rests, and the line passes through the centre of percussion. From
/// its pin the two lines are parallel where it does not gather speed, and the force is laid off at its distance.
#[test]
fn a_mass_that_rests_and_lines_that_do_not_meet() {
    for (first, steady) in [("O", false), ("O", true), ("A", false), ("A", true)] {
        let find = json!([{ "name": "Fin(2)", "method": "two-masses", "first": first }]);
        let mut value = slider_crank(0.7, [0.07, 0.0], &find);
        value["masses"]["2"]["at"] = json!([0.02, 0]);
        if steady {
            value["input"]["alpha"] = json!(0);
        }
        let epsilon = if steady { 0.0 } else { EPSILON };
        let scene = common::read(&value.to_string());
        let solved = solved(&scene);
        let found = reading(&scene, &solved, by_two_masses);
        let (s, c) = 0.7_f64.sin_cos();
        let place = [0.02 * c, 0.02 * s];
        let force = vector(&found.answer);
        let wanted =
            [1.5 * 0.02 * (epsilon * s + OMEGA * OMEGA * c), 1.5 * 0.02 * (-epsilon * c + OMEGA * OMEGA * s)];
        assert!(norm(minus(force, wanted)) < 1e-10, "{force:?} {wanted:?}");
        let moment = cross(minus(found.through.unwrap(), place), force);
        assert!((moment + 0.003 * epsilon).abs() < 1e-11, "{first} {steady}: {moment}");
        if first == "O" && !steady {
            // h₁ + I/(M h₁) from the pivot.
            let away = 0.02 + 0.003 / (1.5 * 0.02);
            let percussion = [away * c, away * s];
            let off = cross(minus(found.through.unwrap(), percussion), force) / norm(force);
            assert!(off.abs() < 1e-12, "{off}");
        }
    }
}

/// What two masses cannot stand for is said.
#[test]
fn two_masses_are_refused_with_the_reason() {
    let off = json!([{ "name": "Fin(3)", "method": "two-masses", "first": "A", "second": "B" }]);
    let why = refused(&common::read(&slider_crank(0.9, [0.07, 0.02], &off).to_string()), by_two_masses);
    assert!(why.contains("does not lie on the line of the two pins"), "{why}");
    let why = refused(&common::read(&slider_crank(0.9, [0.3, 0.0], &off).to_string()), by_two_masses);
    assert!(why.contains("does not lie between"), "{why}");
    let mut still =
        slider_crank(0.9, [0.07, 0.02], &json!([{ "name": "Fin(3)", "method": "two-masses", "first": "A" }]));
    still["input"]["omega"] = json!(0);
    still["input"]["alpha"] = json!(0);
    let why = refused(&common::read(&still.to_string()), by_two_masses);
    assert!(why.contains("no acceleration"), "{why}");
    let wrong = |find: Value| {
        let value = slider_crank(0.9, [0.07, 0.02], &json!([find]));
        scene::read(&value.to_string(), "wrong").unwrap_err().to_string()
    };
    for (find, told) in [
        (json!({ "name": "Fin(3)", "method": "two-masses" }), "`first` is missing"),
        (json!({ "name": "Fin(3)", "method": "two-masses", "first": "O" }), "no joint of link 3"),
        (json!({ "name": "Fin(3)", "method": "two-masses", "first": "A", "second": "A" }), "at one point"),
        (json!({ "name": "Fin(4)", "method": "two-masses", "first": "B" }), "has but one"),
        (json!({ "name": "T(2)", "method": "two-masses", "first": "A" }), "does not lead to"),
        (json!({ "name": "Fin(3)", "method": "lever" }), "choose `polygon`, `two-masses`"),
        (json!({ "name": "T(2)", "method": "lever", "first": "A" }), "takes points"),
        (json!({ "name": "T(2)", "method": "klein" }), "choose `polygon`, `lever`"),
    ] {
        let error = wrong(find.clone());
        assert!(error.contains(told), "{find}: {error}");
    }
}

/// The effort is what power is left: of the load, the couple, and the inertia of all links.
#[test]
fn the_lever_gives_the_effort() {
    for step in 0..24 {
        let theta = 0.13 + f64::from(step) * std::f64::consts::TAU / 24.0;
        let find = json!([{ "name": "T(2)", "method": "lever" }]);
        let scene = common::read(&slider_crank(theta, [0.07, 0.02], &find).to_string());
        // The number of the polygons stands before it.
        let methods: Vec<Method> = scene.mechanism.asked.iter().map(|asked| asked.method).collect();
        assert_eq!(methods, [Method::Polygon, Method::Lever]);
        let solved = solved(&scene);
        let effort = scalar(&reading(&scene, &solved, |method| *method == Method::Lever).answer);
        let m = motion(theta);
        let (s, c) = theta.sin_cos();
        let crank = moved([[0.0; 2]; 3], [0.02 * c, 0.02 * s], OMEGA, EPSILON);
        let g = of_rod(theta, [0.07, 0.02]);
        let dot = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1];
        let power = dot([-120.0, 35.0], m.b[1]) + 4.0 * m.rod[1]
            - 1.5 * dot(crank[2], crank[1])
            - 0.003 * EPSILON * OMEGA
            - 2.0 * dot(g[2], g[1])
            - 0.012 * m.rod[2] * m.rod[1]
            - 0.8 * dot(m.b[2], m.b[1]);
        let wanted = -power / OMEGA;
        assert!((effort - wanted).abs() < 1e-10 * (wanted.abs() + 10.0), "{theta}: {effort} is not {wanted}");
    }
}

/// A driven slide: the drive along its guide, with a spring and a weight.
#[test]
fn the_lever_gives_a_drive() {
    let value = json!({
        "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["A", "B"], "length": 0.5 } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 1, "through": [0, 0], "angle": 0 } },
                    { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 90 } } ],
        "near": { "B": [0, 0.4] }, "input": { "slide": "A", "at": 0.3, "velocity": 0.7, "acceleration": 0 },
        "gravity": { "g": 10 }, "masses": { "4": { "mass": 6 } },
        "springs": [ { "name": "S", "between": [ { "link": 3, "at": "A" }, { "link": 1, "at": "O" } ], "force": 25 } ],
        "find": [ { "name": "drive(A)", "method": "lever" } ]
    });
    let scene = common::read(&value.to_string());
    let solved = solved(&scene);
    let drive = scalar(&reading(&scene, &solved, |method| *method == Method::Lever).answer);
    // x² + y² = l²: ẏ = −x ẋ / y, ÿ = −(ẋ² + ẏ²) / y.
    let (x, y, v) = (0.3, 0.4, 0.7);
    let up: f64 = -x * v / y;
    let rising = -(v * v + up * up) / y;
    let wanted = 25.0 + 6.0 * (10.0 + rising) * up / v;
    // The rod has no mass: what moves the weight and the spring comes from the drive alone.
    assert!((drive - wanted).abs() < 1e-10, "{drive} is not {wanted}");
}

/// Every kind of the catalogue under weights, inertia and loads: the lever gives the number of the independent solver, or says
/// why it gives none.
#[test]
fn the_lever_of_every_kind_of_the_catalogue() {
    let mut answered = 0;
    let mut told: Vec<String> = Vec::new();
    for kind in linkgram::catalogue::KINDS {
        let mut value: Value = serde_json::from_str(kind.scene).unwrap();
        if ["masses", "cycle"].iter().any(|key| value.get(key).is_some()) {
            continue;
        }
        loaded(&mut value, 1.0);
        let plain = scene::read(&value.to_string(), kind.name).unwrap();
        let effort = |name: &&String| name.starts_with("T(") || name.starts_with("drive(");
        let names: Vec<String> = plain.mechanism.asked.iter().map(|asked| asked.name.clone()).collect();
        let find: Vec<Value> =
            names.iter().filter(effort).map(|name| json!({ "name": name, "method": "lever" })).collect();
        value["find"] = json!(find);
        match scene::read(&value.to_string(), kind.name) {
            Ok(scene) => {
                let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
                let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
                assert!(agreement.ok(), "{}: {:?}", kind.name, agreement.disagreements());
                match reading(&scene, &solved, |method| *method == Method::Lever).answer {
                    Answer::Scalar { .. } => answered += 1,
                    other => told.push(format!("{}: {other:?}", kind.name)),
                }
            }
            Err(why) => told.push(format!("{}: {why}", kind.name)),
        }
    }
    println!("{answered} levers; {told:#?}");
    assert!(answered >= 20, "{answered} {told:#?}");
    for why in &told {
        assert!(
            ["one equation", "this guide moves", "nothing moves"].iter().any(|known| why.contains(known)),
            "{why}"
        );
    }
}

/// Where the lever says nothing of an effort, it says why.
#[test]
fn the_lever_is_refused_with_the_reason() {
    let lever = json!([{ "name": "T(2)", "method": "lever" }]);
    let mut rubs = slider_crank(0.9, [0.07, 0.02], &lever);
    rubs["slides"][0]["f"] = json!(0.1);
    let error = scene::read(&rubs.to_string(), "rubs").unwrap_err().to_string();
    assert!(error.contains("no friction"), "{error}");
    rubs["find"] = json!(["T(2)"]);
    let scene = common::read(&rubs.to_string());
    let error = sheet::auxiliary("lever", &scene).unwrap_err();
    assert!(error.contains("no friction"), "{error}");
    let mut still = slider_crank(0.9, [0.07, 0.02], &lever);
    still["input"]["omega"] = json!(0);
    let why = refused(&common::read(&still.to_string()), |method| *method == Method::Lever);
    assert!(why.contains("nothing moves"), "{why}");
}

/// Each number of a sweep is that of the polygons, whatever the method.
#[test]
fn a_sweep_reads_the_polygons() {
    let find = json!([{ "name": "T(2)", "method": "lever" }, { "name": "Fin(3)", "method": "two-masses", "first": "A" }]);
    let scene = common::read(&slider_crank(0.9, [0.07, 0.02], &find).to_string());
    let sweep = linkgram::sweep::Sweep::new(&scene.mechanism, None).unwrap();
    let here = sweep.at(0.9).unwrap();
    let solved = solved(&scene);
    let effort = scalar(&reading(&scene, &solved, |method| *method == Method::Lever).answer);
    // T(2) of the polygons, T(2) of the lever, Fin(3).
    for column in &here[..2] {
        let found = column.unwrap().value;
        assert!((found - effort).abs() < 1e-9 * effort.abs(), "{found} is not {effort}");
    }
}

/// The figures in three languages: no text touches anything, and everything stays on the paper.
#[test]
fn the_figures_are_legible() {
    for (figure, centre) in [
        ("equivalent(3,A)", [0.07, 0.02]),
        ("equivalent(3,A,B)", [0.07, 0.0]),
        ("equivalent(2,A)", [0.07, 0.0]),
        ("lever", [0.07, 0.02]),
    ] {
        let scene = common::read(&slider_crank(0.9, centre, &json!(["T(2)", "Fin(3)"])).to_string());
        let auxiliary = sheet::auxiliary(figure, &scene).unwrap().unwrap();
        let solved =
            solve_with(&scene, Extent::WholeSkeleton, &[auxiliary], Settings::default(), scale::for_scene)
                .unwrap();
        check::confirm(&scene, &solved).unwrap();
        for language in [Language::English, Language::Arabic, Language::Persian] {
            let drawn = sheet::single(&scene, &solved.solution.construction, figure, language).unwrap();
            let overlaps = overlap::overlaps(&drawn);
            assert!(overlaps.is_empty(), "{figure}: {overlaps:?}");
            assert!(drawn.width <= 210.0, "{figure} is {} mm wide", drawn.width);
        }
    }
    let scene = common::read(&slider_crank(0.9, [0.07, 0.0], &json!(["T(2)"])).to_string());
    for (figure, told) in [
        ("equivalent", "write equivalent(3,A)"),
        ("equivalent(9,A)", "no link 9"),
        ("equivalent(3,O)", "no joint of the link"),
        ("equivalent(3,X)", "no point X"),
        ("equivalent(3,A,A)", "at one point"),
        ("lever(2)", "write lever"),
    ] {
        let error = sheet::auxiliary(figure, &scene).unwrap_err();
        assert!(error.contains(told), "{figure}: {error}");
    }
}

/// A four-bar of which one rod is loaded, or a slider-crank with a loaded rod, or a slotted lever: both routes give the
/// forces that the independent solver has, and their lines meet.
#[test]
fn both_routes_give_the_same_forces() {
    let four_bar = json!({
        "fixed": { "O2": [0, 0], "O4": [0.13, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 0.05 }, "3": { "joins": ["A", "B"], "length": 0.12 },
                   "4": { "joins": ["O4", "B", "C"], "sides": [0.09, 0.07, 0.06], "turn": "ccw" } },
        "near": { "B": [0.16, 0.09] }, "input": { "link": 2, "angle": 65, "omega": 20 },
        "loads": [ { "name": "P", "on": 4, "at": "C", "force": [30, -70] } ],
        "find": ["F(2,3)", "F(1,4)", "T(2)"]
    });
    let mut loaded_coupler = four_bar.clone();
    loaded_coupler["loads"] =
        json!([ { "name": "P", "on": 3, "at": "B", "force": [30, -70] }, { "on": 3, "torque": 2 } ]);
    let mut rod = slider_crank(0.9, [0.07, 0.02], &json!(["F(2,3)", "F(3,4)", "T(2)"]));
    rod["masses"].as_object_mut().unwrap().remove("4");
    rod["loads"] =
        json!([ { "name": "P", "on": 3, "at": "B", "force": [-50, 35] }, { "on": 3, "torque": 4 } ]);
    let slotted = json!({
        "fixed": { "O2": [0, 0], "O4": [0, -0.2] },
        "links": { "2": { "joins": ["O2", "A"], "length": 0.06 }, "4": { "joins": ["O4", "D"], "length": 0.35 } },
        "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "D" } } ],
        "near": { "D": [0.05, 0.14] }, "input": { "link": 2, "angle": 30, "omega": 8 },
        "masses": { "4": { "mass": 5, "at": [0.15, 0.02], "inertia": 0.05 } },
        "loads": [ { "name": "P", "on": 4, "at": "D", "force": [-40, 5] } ],
        "find": ["F(1,4)", "T(2)"]
    });
    for (value, name) in
        [(four_bar, "F(3,4)"), (loaded_coupler, "F(3,4)"), (rod, "F(1,4)"), (slotted, "F(3,4)")]
    {
        let mut told: Vec<Vec<Answer>> = Vec::new();
        for method in ["polygon", "components", "three-force"] {
            let mut value = value.clone();
            value["find"].as_array_mut().unwrap().push(json!({ "name": name, "method": method }));
            let scene = common::read(&value.to_string());
            let solved = solved(&scene);
            let construction = &solved.solution.construction;
            told.push(construction.answers.iter().map(|reading| reading.answer.clone()).collect());
            let meets = &construction.forces.as_ref().unwrap().meets;
            assert_eq!(meets.len(), usize::from(method == "three-force"), "{name} {method}");
            let Some(meet) = meets.first() else { continue };
            // Every force that the triangle gives passes through the meet.
            let body = &construction.forces.as_ref().unwrap().bodies[meet.told];
            let found: Vec<_> = body.acting.iter().filter(|acting| acting.closes).collect();
            assert_eq!(found.len(), 2, "{name}");
            for acting in found {
                let off = cross(minus(acting.through, meet.at), acting.force);
                assert!(off.abs() < 1e-9 * norm(acting.force), "{name}: {off}");
            }
            for figure in ["bodies", "polygons"] {
                let drawn = sheet::single(&scene, construction, figure, Language::English).unwrap();
                let overlaps = overlap::overlaps(&drawn);
                assert!(overlaps.is_empty(), "{name} {figure}: {overlaps:?}");
            }
        }
        for other in &told[1..] {
            for (one, other) in told[0].iter().zip(other) {
                let apart = match (one, other) {
                    (Answer::Vector { value: a, .. }, Answer::Vector { value: b, .. }) => norm(minus(*a, *b)),
                    (Answer::Scalar { value: a, .. }, Answer::Scalar { value: b, .. }) => (a - b).abs(),
                    other => panic!("{other:?}"),
                };
                assert!(apart < 1e-9, "{name}: {apart}");
            }
        }
    }
}

/// Where there is but one route, the reason is said, and everything else is answered.
#[test]
fn a_route_that_does_not_exist_is_refused_with_the_reason() {
    let of = |name: &str, method: &str, change: &dyn Fn(&mut Value)| {
        let mut value = json!({
            "fixed": { "O2": [0, 0], "O4": [0.13, 0] },
            "links": { "2": { "joins": ["O2", "A"], "length": 0.05 }, "3": { "joins": ["A", "B"], "length": 0.12 },
                       "4": { "joins": ["O4", "B"], "length": 0.09 } },
            "near": { "B": [0.16, 0.09] }, "input": { "link": 2, "angle": 65, "omega": 20 },
            "loads": [ { "name": "P", "on": 4, "at": "B", "force": [30, -70] } ],
            "find": ["T(2)", { "name": name, "method": method }]
        });
        change(&mut value);
        let scene = common::read(&value.to_string());
        let solved = solve(&scene, Extent::Asked, scale::for_scene).unwrap();
        let answers = &solved.solution.construction.answers;
        assert!(matches!(answers[0].answer, Answer::Scalar { .. }));
        match &answers[1].answer {
            Answer::Indeterminate(Indeterminate::Undefined { why }) => why.clone(),
            other => panic!("{other:?}"),
        }
    };
    let two = |value: &mut Value| value["masses"] = json!({ "3": { "mass": 1, "at": [0.05, 0] } });
    let couple = |value: &mut Value| value["loads"] = json!([{ "on": 4, "torque": 3 }]);
    let parallel = |value: &mut Value| {
        value["loads"] =
            json!([{ "on": 4, "at": "O4", "force": 9, "direction": { "from": "A", "to": "B" } }]);
    };
    let same = |_: &mut Value| {};
    for (why, told) in [
        (of("F(3,4)", "three-force", &two), "something acts on both links"),
        (of("F(3,4)", "three-force", &couple), "a couple alone"),
        (of("F(3,4)", "three-force", &parallel), "parallel"),
        (of("F(1,2)", "three-force", &same), "one route alone"),
        (of("F(1,2)", "components", &same), "one route alone"),
    ] {
        assert!(why.contains(told), "{why}");
    }
    let rubs = json!({
        "fixed": { "O": [0, 0] },
        "links": { "2": { "joins": ["O", "A"], "length": 0.05 }, "3": { "joins": ["A", "B"], "length": 0.2 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O" }, "f": 0.1 } ],
        "near": { "B": [0.2, 0] }, "input": { "link": 2, "angle": 50, "omega": 3 },
        "loads": [ { "on": 4, "at": "B", "force": [-9, 0] } ],
        "find": [ { "name": "F(1,4)", "method": "three-force" } ]
    });
    let error = scene::read(&rubs.to_string(), "rubs").unwrap_err().to_string();
    assert!(error.contains("where nothing rubs"), "{error}");
}

/// The line of the lever that gives a torque says its sense once: no size is negative before it, whichever way the crank turns.
#[test]
fn the_lever_tells_the_sense_of_a_torque_once() {
    let mut senses = std::collections::BTreeSet::new();
    for (omega, load) in [(OMEGA, -400.0), (-OMEGA, -400.0), (OMEGA, 900.0), (-OMEGA, 900.0)] {
        let mut value = slider_crank(1.1, [0.08, 0.0], &json!([{ "name": "T(2)", "method": "lever" }]));
        value["input"]["omega"] = json!(omega);
        value["loads"] = json!([{ "name": "P", "on": 4, "at": "B", "force": [load, 0] }]);
        let scene = common::read(&value.to_string());
        let Answer::Scalar { value: torque, .. } =
            solve_analytically(&scene).unwrap().answer(&scene.mechanism.asked[0].quantity)
        else {
            panic!("no torque")
        };
        let sense = if torque > 0.0 { "ccw" } else { "cw" };
        let wish = linkgram::drawing::Wish::default();
        let figure = linkgram::drawing::figure(&scene, &wish).unwrap();
        let lines = crate::legibility::sentences(&figure);
        let line =
            lines.iter().find(|line| line.contains("T_2") && line.contains('Σ') && line.contains("ω_2"));
        let line = line.unwrap_or_else(|| panic!("{lines:#?}")).replace('\u{a0}', " ");
        let result = line.trim_end_matches('.').rsplit('=').next().unwrap().trim().to_owned();
        assert!(result.ends_with(&format!(" {sense}")) && !result.starts_with('−'), "{line}");
        let (size, half, _) = crate::legibility::number(&result).unwrap();
        assert!((size - torque.abs()).abs() < 3.0 * half, "{line}, and it is {torque}");
        senses.insert((sense, omega > 0.0));
    }
    assert_eq!(senses.len(), 4, "{senses:?}");
}
