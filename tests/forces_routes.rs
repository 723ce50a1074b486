//! Routes of balance: every kind of the catalogue with weights, inertia and a load, and random mechanisms of every kind of
//! group; rolling pairs against closed forms.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::collections::{BTreeMap, BTreeSet};

use linkgram::check;
use linkgram::mechanism::force::Party;
use linkgram::mechanism::quantity::{Answer, Indeterminate};
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::solve::{SolveError, solve, solve_analytically};
use serde_json::{Value, json};

use crate::common;
use crate::pairs::builder::{build, plan};

/// Gives every moving link a mass with a moment of inertia and every block one without, lets weights act, and loads two
/// links; the factor is that of the weights.
pub fn loaded(scene: &mut Value, heavy: f64) {
    let mut bodies: BTreeMap<u64, Vec<String>> = BTreeMap::new();
    for (number, link) in scene["links"].as_object().unwrap() {
        let joins = link["joins"].as_array().unwrap();
        let joins = joins.iter().map(|p| p.as_str().unwrap().to_owned()).collect();
        bodies.insert(number.parse().unwrap(), joins);
    }
    for slide in scene["slides"].as_array().into_iter().flatten() {
        if let Some(block) = slide["block"].as_u64() {
            bodies.insert(block, vec![slide["pin"].as_str().unwrap().to_owned()]);
        }
    }
    let mut masses = serde_json::Map::new();
    for (place, (number, points)) in (1_u32..).zip(&bodies) {
        let mut mass = json!({ "mass": heavy * (0.6 + 0.7 * f64::from(place)) });
        if scene["links"].get(number.to_string()).is_some() {
            mass["inertia"] = (0.02 * f64::from(place)).into();
        }
        if points.len() > 1 {
            mass["at"] = points.last().unwrap().clone().into();
        }
        masses.insert(number.to_string(), mass);
    }
    let (first, _) = bodies.iter().next().unwrap();
    let (last, points) = bodies.iter().next_back().unwrap();
    scene["gravity"] = json!({});
    scene["masses"] = masses.into();
    scene["loads"] = json!([
        { "name": "P", "on": last, "at": points.last().unwrap(), "force": [30, -70] },
        { "name": "M", "on": first, "torque": "2 N*m" }
    ]);
    scene.as_object_mut().unwrap().remove("find");
}

/// Answers of the board by name, after both solvers were found to agree; or why the scene is refused.
fn answers(value: &Value) -> Result<(Scene, BTreeMap<String, Answer>), SolveError> {
    let scene = common::read(&value.to_string());
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene)?;
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(
        agreement.ok(),
        "{:?} {:?} {:?} {:?}\n{value}",
        agreement.elsewhere,
        agreement.refused,
        agreement.power,
        agreement.disagreements()
    );
    let compared = scene.mechanism.asked.iter().zip(&agreement.compared);
    let told = compared.map(|(asked, compared)| (asked.name.clone(), compared.graphical.answer.clone()));
    let told = told.collect();
    Ok((scene, told))
}

/// Every kind of the catalogue is answered for its efforts, the forces of all its pairs and FS, whatever groups it has;
/// a wheel that only its weight keeps on its rail is not, where the weight is too small.
#[test]
fn every_kind_of_the_catalogue_is_answered_under_load() {
    let mut refused: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    let mut forces = 0;
    for kind in linkgram::catalogue::KINDS {
        let mut value: Value = serde_json::from_str(kind.scene).unwrap();
        if ["masses", "cycle"].iter().any(|key| value.get(key).is_some()) {
            // Kinds with forces of their own.
            continue;
        }
        loaded(&mut value, 1.0);
        let plain = scene::read(&value.to_string(), kind.name).unwrap();
        let mut find: Vec<String> = plain.mechanism.asked.iter().map(|asked| asked.name.clone()).collect();
        find.extend(["FS", "F(frame)"].map(str::to_owned));
        value["find"] = json!(find);
        match answers(&value) {
            Ok((_, found)) => {
                for (name, answer) in &found {
                    if let Answer::Indeterminate(why) = answer {
                        refused.entry(format!("{name}: {why}")).or_default().push(kind.name);
                    }
                }
                forces += found.len();
            }
            Err(why) => refused.entry(why.to_string()).or_default().push(kind.name),
        }
    }
    println!("{forces} answers, refused: {refused:#?}");
    assert!(refused.is_empty(), "{refused:#?}");
}

/// A wheel that nothing but its weight keeps on its rail: what a closed form says, until it would have to pull.
#[test]
fn a_contact_has_to_push() {
    let with = |weight: f64, extra: &str| {
        let text = format!(
            r#"{{ "placed": {{ "C": [0, 0.5], "Q": [0.3, 0.9] }}, "links": {{ "2": {{ "joins": ["C", "Q"] }} }},
            "rolls": [ {{ "links": [1, 2], "line": {{ "link": 1, "through": [0, 0], "angle": 0 }}, "centre": "C", "radius": 0.5 }} ],
            "input": {{ "link": 2, "omega": -4, "alpha": -6 }}, "gravity": {{ "g": 10 }},
            "masses": {{ "2": {{ "mass": {weight}, "at": "C", "inertia": 2 }} }},
            "loads": [ {{ "on": 2, "at": "Q", "force": [5, 30] }} ], "find": ["T(2)", "F(1,2)", "moment(F(1,2),C)"] {extra} }}"#
        );
        serde_json::from_str::<Value>(&text).unwrap()
    };
    let (_, found) = answers(&with(8.0, "")).unwrap();
    let near = |answer: &Answer, wanted: &[f64]| {
        let found = match answer {
            Answer::Scalar { value, .. } => vec![*value],
            Answer::Vector { value, .. } => value.to_vec(),
            other => panic!("{other:?}"),
        };
        for (found, wanted) in found.iter().zip(wanted) {
            assert!((found - wanted).abs() < 1e-12 * wanted.abs().max(1.0), "{found} is not {wanted}");
        }
    };
    // The wheel rolls to the right: a = ε r = 3; the rail holds it back or drives it by M a − F_x.
    near(&found["F(1,2)"], &[8.0 * 3.0 - 5.0, 80.0 - 30.0]);
    near(&found["moment(F(1,2),C)"], &[(8.0 * 3.0 - 5.0) * 0.5]);
    // About the contact: I ε + M a r + ... = T + moments of the load.
    near(&found["T(2)"], &[-2.0 * 6.0 - 8.0 * 3.0 * 0.5 - (0.3 * 30.0 - 0.9 * 5.0)]);
    match answers(&with(2.0, "")) {
        Err(SolveError::Indeterminate { why: Indeterminate::NoEquilibrium { why }, .. }) => {
            assert!(why.contains("would have to pull"), "{why}");
        }
        other => panic!("{other:?}"),
    }
    let expected = common::read(&with(2.0, r#", "expect": "no-equilibrium""#).to_string());
    assert!(check::check(&expected, 0.05).ok);
}

/// In a sweep in which what a tooth carries turns round the wheels are pushed apart by the other flank: W l cos θ / r along the
/// tangent, and tan 20° of it outwards, to either side.
#[test]
fn teeth_push_apart_by_either_flank_in_a_sweep() {
    let sought = r#"{ "name": "X", "on": 3, "torque": "?" }, "#;
    for loads in ["", sought] {
        let scene = common::read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O3": [75, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 20 }}, "3": {{ "joins": ["O3"] }} }},
            "rolls": [ {{ "links": [2, 3], "centres": ["O2", "O3"], "radii": [30, 45], "pressure": 20 }} ],
            "input": {{ "link": 2, "angle": 30, "omega": "10 rad/s ccw" }},
            "loads": [ {loads} {} ], "find": ["F(2,3)"] }}"#,
            if loads.is_empty() {
                // The input feels the torque of wheel 3 alone.
                r#"{ "name": "M", "on": 3, "torque": { "harmonics": { "cos": [[1, 3]] } } }"#
            } else {
                r#"{ "name": "W", "on": 2, "at": "A", "force": 120, "direction": -90 }"#
            }
        ));
        let sweep = linkgram::sweep::Sweep::new(&scene.mechanism, None).unwrap();
        assert!(check::confirm_sweep(&sweep).unwrap() > 2);
        let parts = [0, 1].map(|axis| sweep.columns.iter().position(|c| c.axis == Some(axis)).unwrap());
        for position in sweep.positions(&sweep.equal_steps(24)) {
            let [Some(x), Some(y)] = parts.map(|part| position.values[part]) else { panic!("no force") };
            let cos = libm::cos(position.at);
            let tangent = if loads.is_empty() { 3.0 / 0.045 * cos } else { 120.0 * 20.0 / 30.0 * cos };
            let outward = tangent.abs() * libm::tan(20.0_f64.to_radians());
            assert!((y.abs() - tangent.abs()).abs() < 1e-9 * 100.0, "{}: {y}, {tangent}", position.at);
            assert!((x - outward).abs() < 1e-9 * 100.0, "{}: {x}, {outward}", position.at);
        }
    }
}

/// Teeth: 20° where nothing is said, the stated angle, or smooth wheels; pushed apart whichever way they drive.
#[test]
fn teeth_push_apart() {
    let pair = |teeth: &str, internal: bool, torque: f64| {
        let text = format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O3": [{}, 0] }}, "placed": {{ "A": [0.5, 0], "B": [1, 3] }},
            "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["O3", "B"] }} }},
            "rolls": [ {{ "links": [2, 3], "centres": ["O2", "O3"], "internal": {internal}, {teeth} }} ],
            "input": {{ "link": 2, "omega": 3 }}, "loads": [ {{ "on": 3, "torque": {torque} }} ],
            "find": ["T(2)", "F(2,3)", "F(1,3)", "moment(F(2,3),O3)"] }}"#,
            if internal { -1.0 } else { 3.0 }
        );
        let (_, found) = answers(&serde_json::from_str(&text).unwrap()).unwrap();
        let vector = match found["F(2,3)"] {
            Answer::Vector { value, .. } => value,
            ref other => panic!("{other:?}"),
        };
        let Answer::Scalar { value, .. } = found["T(2)"] else { panic!() };
        (vector, value)
    };
    let near = |[x, y]: [f64; 2], wanted: [f64; 2]| {
        assert!((x - wanted[0]).hypot(y - wanted[1]) < 1e-12 * 100.0, "{x}, {y} is not {wanted:?}");
    };
    let tan = 20.0_f64.to_radians().tan();
    for torque in [60.0, -60.0] {
        // Radii 1 and 2, contact at (1, 0): F_y turns link 3 by −2 F_y.
        let across = torque / 2.0;
        let (force, effort) = pair(r#""teeth": [20, 40], "module": 0.1"#, false, torque);
        near(force, [across.abs() * tan, across]);
        near([effort, 0.0], [across, 0.0]);
        near(
            pair(r#""radii": [1, 2], "pressure": "14.5 deg""#, false, torque).0,
            [across.abs() * 14.5_f64.to_radians().tan(), across],
        );
        near(pair(r#""radii": [1, 2]"#, false, torque).0, [0.0, across]);
        // In a ring the pinion is pushed to the ring's centre, the ring away from it: radii 1 and 2, contact at (1, 0).
        let (force, effort) = pair(r#""teeth": [20, 40], "module": 0.1"#, true, torque);
        near(force, [across.abs() * tan, -across]);
        near([effort, 0.0], [-across, 0.0]);
    }
}

/// What pairs exert on a body, with their moments about a joint of it.
fn everything_on(scene: &Scene, number: u32) -> Vec<String> {
    let m = &scene.mechanism;
    let link = m.link_numbered(number).unwrap();
    let mut names = BTreeSet::new();
    for point in &m.points {
        let parties = m.parties_at(m.point_named(&point.name).unwrap());
        if parties.len() > 1 && parties.contains(&link) {
            names.insert(format!("F({},{number})", point.name));
        }
    }
    let pair = |one: u32, other: u32| format!("F({},{number})", if one == number { other } else { one });
    for slide in &m.slides {
        let Party::Link(rider) = m.party_of(&slide.rider) else { continue };
        if [rider, slide.guide.link].contains(&link) {
            names.insert(pair(m.link(rider).number, m.link(slide.guide.link).number));
        }
    }
    for roll in &m.rolls {
        let [one, other] = roll.bodies();
        if [one, other].contains(&link) {
            names.insert(pair(m.link(one).number, m.link(other).number));
        }
    }
    names.into_iter().collect()
}

/// One random mechanism under load: both solvers agree, every body is in balance by the printed values alone, and the
/// efforts do the work of everything else by the printed velocities. Says why it is refused, where it is.
fn run(mut value: Value) -> Result<(), String> {
    loaded(&mut value, 1.0);
    // Every other pair has teeth.
    for roll in value["rolls"].as_array_mut().unwrap().iter_mut().step_by(2) {
        roll["pressure"] = json!("20 deg");
    }
    let plain = scene::read(&value.to_string(), "random").map_err(|why| format!("unread: {why}\n{value}"))?;
    let m = &plain.mechanism;
    for (index, point) in m.points.iter().enumerate() {
        let pin = linkgram::mechanism::PointId(index);
        if m.parties_at(pin).len() > 2 && m.carrier(pin).is_none() {
            value["pins"][&point.name] = json!({ "carrier": m.link(point.links[0]).number });
        }
    }
    let plain = scene::read(&value.to_string(), "random").unwrap();
    let m = &plain.mechanism;
    let mut find: Vec<String> = Vec::new();
    let driven: Vec<u32> = value["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|i| i["link"].as_u64())
        .map(|n| n as u32)
        .collect();
    let sliding: Vec<u32> = value["inputs"]
        .as_array()
        .unwrap()
        .iter()
        .filter_map(|i| i["slide"].as_u64())
        .map(|n| n as u32)
        .collect();
    let efforts =
        driven.iter().map(|n| format!("T({n})")).chain(sliding.iter().map(|n| format!("drive({n})")));
    let efforts: Vec<String> = efforts.collect();
    for name in &efforts {
        find.extend([name.clone(), format!("{name}.static"), format!("{name}.inertia")]);
    }
    let numbers: Vec<u32> = m.moving().map(|link| m.link(link).number).collect();
    let joint_of = |number: u32| {
        let link = m.link_numbered(number).unwrap();
        m.point(m.link(link).points[0]).name.clone()
    };
    for &number in &numbers {
        let about = joint_of(number);
        let names = everything_on(&plain, number);
        find.extend(names.iter().flat_map(|name| [name.clone(), format!("moment({name},{about})")]));
        find.extend([
            format!("omega({number})"),
            format!("alpha({number})"),
            format!("x({about})"),
            format!("Fin({number})"),
        ]);
        let link = m.link_numbered(number).unwrap();
        let centre = m.forces.mass(link).unwrap().centre;
        let centre = &m.point(centre).name;
        find.extend([format!("x({centre})"), format!("v({centre})"), format!("a({centre})")]);
    }
    let loaded_point = m.forces.loads[0].at().unwrap();
    let loaded_point = m.point(loaded_point).name.clone();
    find.extend([format!("v({loaded_point})"), format!("x({loaded_point})")]);
    let mut once = BTreeSet::new();
    find.retain(|name| once.insert(name.clone()));
    find.retain(|name| {
        let mut one = value.clone();
        one["find"] = json!([name]);
        scene::read(&one.to_string(), "one").is_ok()
    });
    value["find"] = json!(find);
    let (scene, found) = answers(&value).map_err(|why| match why {
        SolveError::Indeterminate { why, .. } => why.to_string(),
        other => format!("not solved: {other}\n{value}"),
    })?;
    let mut indeterminate = found.iter().filter_map(|(name, answer)| match answer {
        Answer::Indeterminate(why) => Some((name, why)),
        _ => None,
    });
    if let Some((name, why)) = indeterminate.next() {
        return Err(match why {
            Indeterminate::NoEquilibrium { .. }
            | Indeterminate::DeadCentre { .. }
            | Indeterminate::Singular => why.to_string(),
            other => format!("{name}: {other}\n{value}"),
        });
    }
    let vector = |name: &str| match found.get(name) {
        Some(Answer::Vector { value, bound }) => (*value, *bound),
        // What is fixed does not move.
        None => ([0.0; 2], 0.0),
        Some(other) => panic!("{name}: {other:?}"),
    };
    let scalar = |name: &str| match found.get(name) {
        Some(Answer::Scalar { value, bound }) => (*value, *bound),
        // A block has no rates of its own in a scene.
        None => (0.0, 0.0),
        Some(other) => panic!("{name}: {other:?}"),
    };
    for name in &efforts {
        let [total, fixed, moved] = ["", ".static", ".inertia"].map(|part| scalar(&format!("{name}{part}")));
        let apart = (total.0 - fixed.0 - moved.0).abs();
        let size = total.0.abs() + fixed.0.abs() + moved.0.abs();
        assert!(
            apart <= total.1 + fixed.1 + moved.1 + 1e-15 * size,
            "{name}: superposition {apart}\n{value}"
        );
    }
    let place = |name: &str| {
        let point = scene.mechanism.point_named(name).unwrap();
        match scene.mechanism.point(point).place.exact() {
            Some(at) if scene.mechanism.is_fixed(point) => [at[0].value, at[1].value],
            _ => vector(&format!("x({name})")).0,
        }
    };
    let m = &scene.mechanism;
    let (mut power, mut allowed) = (0.0, 0.0);
    let mut works = |power_of: f64, bound: f64| {
        power += power_of;
        allowed += bound + 1e-12 * power_of.abs();
    };
    for &n in &driven {
        let ((torque, bound), (omega, slack)) = (scalar(&format!("T({n})")), scalar(&format!("omega({n})")));
        works(torque * omega, bound * omega.abs() + slack * torque.abs());
    }
    for input in value["inputs"].as_array().unwrap() {
        if let Some(n) = input["slide"].as_u64() {
            let (force, bound) = scalar(&format!("drive({n})"));
            let speed = input["velocity"].as_f64().unwrap();
            works(force * speed, bound * speed.abs());
        }
    }
    for &number in &numbers {
        let link = m.link_numbered(number).unwrap();
        let about = joint_of(number);
        let at = place(&about);
        let ([mut x, mut y], mut moment) = ([0.0; 2], 0.0);
        let (mut loose, mut turning) = (0.0, 0.0);
        for name in everything_on(&scene, number) {
            let ([fx, fy], bound) = vector(&name);
            let (turn, slack) = scalar(&format!("moment({name},{about})"));
            (x, y, moment) = (x + fx, y + fy, moment + turn);
            loose += bound + 1e-14 * fx.hypot(fy);
            turning += slack + 1e-14 * turn.abs();
        }
        let mass = m.forces.mass(link).unwrap();
        let centre = &m.point(mass.centre).name;
        let linkgram::mechanism::force::Heaviness::Mass(kilograms) = mass.heaviness else { panic!() };
        let inertia = match mass.inertia {
            linkgram::mechanism::force::Inertia::Central(inertia) => inertia.value,
            _ => 0.0,
        };
        let ([ax, ay], slack) = vector(&format!("a({centre})"));
        let alpha = scalar(&format!("alpha({number})"));
        let omega = scalar(&format!("omega({number})"));
        let kg = kilograms.value;
        let (fx, fy) = (-kg * ax, -kg * (ay + 9.81));
        let [gx, gy] = place(centre);
        let arm = [gx - at[0], gy - at[1]];
        (x, y) = (x + fx, y + fy);
        moment += arm[0] * fy - arm[1] * fx - inertia * alpha.0;
        loose += kg * slack + 1e-13 * fx.hypot(fy);
        turning += arm[0].hypot(arm[1]) * kg * slack + inertia * alpha.1;
        turning += 1e-12 * (fx.hypot(fy) * (gx.hypot(gy) + at[0].hypot(at[1])) + (inertia * alpha.0).abs());
        let ([vx, vy], slow) = vector(&format!("v({centre})"));
        works(
            fx * vx + fy * vy - inertia * alpha.0 * omega.0,
            fx.hypot(fy) * slow
                + kg * slack * vx.hypot(vy)
                + inertia * (alpha.1 * omega.0.abs() + omega.1 * alpha.0.abs()),
        );
        for load in m.forces.loads.iter().filter(|load| load.link == link) {
            if load.is_torque() {
                moment += 2.0;
                works(2.0 * omega.0, 2.0 * omega.1);
            } else {
                let [px, py] = place(&loaded_point);
                (x, y) = (x + 30.0, y - 70.0);
                moment += (px - at[0]) * -70.0 - (py - at[1]) * 30.0;
                turning += 1e-12 * 100.0 * (px.hypot(py) + at[0].hypot(at[1]));
                let ([vx, vy], slow) = vector(&format!("v({loaded_point})"));
                works(30.0 * vx - 70.0 * vy, 77.0 * slow);
            }
        }
        if driven.contains(&number) {
            let (torque, bound) = scalar(&format!("T({number})"));
            moment += torque;
            turning += bound + 1e-14 * torque.abs();
        }
        // What drives a slide acts on its rider and on its carrier, along a guide that the scene does not print.
        let drives = m.slides.iter().any(|slide| {
            let rider = match m.party_of(&slide.rider) {
                Party::Link(rider) => m.link(rider).number,
                Party::Pin(_) => 0,
            };
            sliding.contains(&rider) && [rider, m.link(slide.guide.link).number].contains(&number)
        });
        if !drives {
            assert!(x.hypot(y) <= loose, "link {number}: {x}, {y} within {loose}\n{value}");
            assert!(moment.abs() <= turning, "link {number}: {moment} within {turning}\n{value}");
        }
    }
    assert!(power.abs() <= allowed, "power {power} within {allowed}\n{value}");
    Ok(())
}

/// So many random mechanisms; how many were answered, and why the others were not.
fn campaign(cases: u32, groups: usize) -> (usize, BTreeMap<String, usize>) {
    let mut runner = proptest::test_runner::TestRunner::new(common::fixed(cases));
    let answered = std::cell::Cell::new(0);
    let refused = std::cell::RefCell::new(BTreeMap::new());
    let tried = runner.run(&plan(groups), |plan| {
        if let Some(made) = build(&plan) {
            match run(made.scene) {
                Ok(()) => answered.set(answered.get() + 1),
                Err(why) => *refused.borrow_mut().entry(why).or_insert(0) += 1,
            }
        }
        Ok(())
    });
    tried.unwrap_or_else(|error| panic!("{error}"));
    (answered.get(), refused.into_inner())
}

#[test]
fn random_mechanisms_of_every_kind_under_load() {
    let (answered, refused) = campaign(120, 3);
    println!("{answered} answered, refused: {refused:#?}");
    assert!(answered >= 40, "{answered}: {refused:#?}");
}

/// The campaign: `cargo test --release --test all forces_routes:: -- --ignored --nocapture`.
#[test]
#[ignore = "long"]
fn many_random_mechanisms_of_every_kind_under_load() {
    let many = std::env::var("LINKGRAM_CHAINS").ok().and_then(|n| n.parse().ok()).unwrap_or(2000);
    let (answered, refused) = campaign(many, 5);
    println!("{answered} answered, refused: {refused:#?}");
    assert!(answered as u32 > many / 4);
}

/// Random mechanisms in which guides and journals rub: both solvers agree, or the same is refused for a reason.
fn rubbing_campaign(cases: u32, groups: usize) -> (usize, BTreeMap<String, usize>) {
    let mut runner = proptest::test_runner::TestRunner::new(common::fixed(cases));
    let answered = std::cell::Cell::new(0);
    let refused = std::cell::RefCell::new(BTreeMap::new());
    let tried = runner.run(&plan(groups), |plan| {
        let Some(made) = build(&plan) else { return Ok(()) };
        let mut value = made.scene;
        loaded(&mut value, 1.0);
        let plain = common::read(&value.to_string());
        let m = &plain.mechanism;
        for (index, point) in m.points.iter().enumerate() {
            let parties = m.parties_at(linkgram::mechanism::PointId(index));
            if parties.len() == 2 && point.links.len() == 2 && index % 2 == 0 {
                value["pins"][&point.name] = json!({ "circle": 0.01 });
            }
        }
        for (index, slide) in value["slides"].as_array_mut().unwrap().iter_mut().enumerate() {
            if index % 2 == 0 {
                slide["f"] = json!(0.04);
            }
        }
        match answers(&value) {
            Ok((_, found)) => {
                let open = found.iter().find_map(|(name, answer)| match answer {
                    Answer::Indeterminate(why) => Some(format!("{name}: {why}")),
                    _ => None,
                });
                match open {
                    None => answered.set(answered.get() + 1),
                    Some(why) => *refused.borrow_mut().entry(why).or_insert(0) += 1,
                }
            }
            Err(why) => *refused.borrow_mut().entry(why.to_string()).or_insert(0) += 1,
        }
        Ok(())
    });
    tried.unwrap_or_else(|error| panic!("{error}"));
    (answered.get(), refused.into_inner())
}

#[test]
fn random_mechanisms_of_every_kind_that_rub() {
    let (answered, refused) = rubbing_campaign(60, 2);
    println!("{answered} answered, refused: {refused:#?}");
    assert!(answered >= 20, "{answered}: {refused:#?}");
}

/// Turning the whole scene turns the forces and keeps the torques: a planet on an arm between a sun and a fixed ring.
#[test]
fn a_turned_gear_train_has_turned_forces() {
    let train = |angle: f64| {
        let (sin, cos) = angle.to_radians().sin_cos();
        let at = |x: f64, y: f64| json!([cos * x - sin * y, sin * x + cos * y]);
        let value = json!({
            "fixed": { "O": at(0.0, 0.0) }, "placed": { "B": at(0.2, 0.0), "A": at(0.6, 0.0), "E": at(0.7, 0.2) },
            "links": { "2": { "joins": ["O", "B"] }, "3": { "joins": ["A", "E"] }, "4": { "joins": ["O", "A"] } },
            "rolls": [
                { "links": [2, 3], "centres": ["O", "A"], "radii": [0.3, 0.3], "pressure": "25 deg" },
                { "links": [1, 3], "centres": ["O", "A"], "radii": [0.9, 0.3], "internal": true, "pressure": "25 deg" }
            ],
            "input": { "link": 2, "omega": 10, "alpha": -7 }, "gravity": { "direction": angle - 90.0 },
            "masses": { "3": { "mass": 3, "at": "E", "inertia": 0.1 }, "4": { "mass": 2, "at": "A" } },
            "loads": [ { "on": 4, "torque": -12 } ], "find": ["T(2)", "F(2,3)", "F(1,3)", "F(3,4)", "F(O,4)"]
        });
        answers(&value).unwrap().1
    };
    let (still, other) = (train(0.0), train(37.0));
    let (sin, cos) = 37.0_f64.to_radians().sin_cos();
    for (name, answer) in &still {
        match (answer, &other[name]) {
            (Answer::Scalar { value, .. }, Answer::Scalar { value: turned, .. }) => {
                assert!((value - turned).abs() < 1e-9 * value.abs(), "{name}: {value} and {turned}");
            }
            (Answer::Vector { value: [x, y], .. }, Answer::Vector { value: turned, .. }) => {
                let apart = [turned[0] - (cos * x - sin * y), turned[1] - (sin * x + cos * y)];
                assert!(apart[0].hypot(apart[1]) < 1e-9 * x.hypot(*y), "{name}: {apart:?}");
            }
            other => panic!("{name}: {other:?}"),
        }
    }
}

/// A ram between a lever and a swivelling guide: the drive stands on both, and is no force of their pair. Sides of 300, 350
/// and 400 mm tell the arm about O2 in closed form.
#[test]
fn what_drives_a_bare_pin_stands_on_both_links() {
    let (_, found) = answers(&json!({
        "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O3": [400, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 300 }, "3": { "joins": ["O3"] } },
        "slides": [{ "pin": "A", "on": { "link": 3, "through": "O3" } }],
        "near": { "A": [150, 260] },
        "input": { "slide": "A", "at": 350, "velocity": "50 mm/s" },
        "loads": [{ "on": 2, "torque": "100 N*m" }],
        "find": ["drive(A)", "F(3,2)", "F(2,3)", "F(A,2)", "F(A,3)", "F(1,2)", "F(1,3)", "moment(F(A,2),O2)"]
    }))
    .unwrap();
    let x = (0.3_f64.powi(2) - 0.35_f64.powi(2) + 0.4_f64.powi(2)) / 0.8;
    let y = (0.3_f64.powi(2) - x * x).sqrt();
    let drive = 100.0 / (0.4 * y / 0.35);
    // Along the guide from O3 to A, and the ram pulls.
    let along = [(x - 0.4) / 0.35, y / 0.35];
    let size = |name: &str, expected: [f64; 2]| {
        let Answer::Vector { value, bound } = found[name] else { panic!("{name}") };
        let off = libm::hypot(value[0] - expected[0], value[1] - expected[1]);
        assert!(off <= bound + 1e-10, "{name}: {value:?}, not {expected:?}");
    };
    let Answer::Scalar { value, bound } = found["drive(A)"] else { panic!() };
    assert!((value + drive).abs() <= bound + 1e-10, "{value}, not {}", -drive);
    for name in ["F(3,2)", "F(2,3)", "F(A,3)"] {
        size(name, [0.0; 2]);
    }
    for name in ["F(A,2)", "F(1,3)"] {
        size(name, along.map(|part| -drive * part));
    }
    size("F(1,2)", along.map(|part| drive * part));
    let Answer::Scalar { value, bound } = found["moment(F(A,2),O2)"] else { panic!() };
    assert!((value + 100.0).abs() <= bound + 1e-10, "{value}");
}

/// A mass centre stated by coordinates that are those of a joint is that joint: a balanced crank, a rod's end, driven by the
/// crank or by the coupler. What the joint itself is told is the truth.
#[test]
fn a_mass_centre_may_lie_in_a_joint() {
    for driven in
        [json!({ "link": 2, "angle": 60, "omega": 5 }), json!({ "link": 3, "angle": 10, "omega": 5 })]
    {
        let scene = |masses: Value| {
            json!({
                "units": { "length": "mm" },
                "fixed": { "O2": [0, 0], "O4": [140, -30] },
                "links": {
                    "2": { "joins": ["O2", "A"], "length": 60 },
                    "3": { "joins": ["A", "B"], "length": 120 },
                    "4": { "joins": ["O4", "B"], "length": 95 }
                },
                "near": { "A": [44, 41], "B": [164, 61] }, "input": driven, "gravity": {}, "masses": masses,
                "find": [format!("T({})", driven["link"]), "F(1,4)", "F(1,2)", "a(G2)", "a(G3)", "a(G4)"]
            })
        };
        let heavy = |at: Value| json!({ "mass": 2, "inertia": 0.01, "at": at });
        let joints = [["O2", "A", "O4"], ["A", "B", "B"]];
        let places = [[[0, 0], [0, 0], [0, 0]], [[60, 0], [120, 0], [95, 0]]];
        for (names, places) in joints.into_iter().zip(places) {
            let by_name = names.map(|name| heavy(json!(name)));
            let by_place = places.map(|at| heavy(json!(at)));
            let masses = |[a, b, c]: [Value; 3]| json!({ "2": a, "3": b, "4": c });
            let mut named = scene(masses(by_name));
            named["find"] = json!([named["find"][0], "F(1,4)", "F(1,2)"]);
            let (_, named) = answers(&named).unwrap();
            let (_, placed) = answers(&scene(masses(by_place))).unwrap();
            for (name, truth) in &named {
                let numbers = |answer: &Answer| match *answer {
                    Answer::Scalar { value, bound } => ([value, 0.0], bound),
                    Answer::Vector { value, bound } => (value, bound),
                    ref other => panic!("{name}: {other:?}"),
                };
                let ((told, bound), (truth, slack)) = (numbers(&placed[name]), numbers(truth));
                let off = libm::hypot(told[0] - truth[0], told[1] - truth[1]);
                assert!(off <= bound + slack, "{name}: {told:?}, not {truth:?}");
            }
        }
    }
}
