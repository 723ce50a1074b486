//! Governors: printed values, the closed forms of Watt and Porter, and what has no speed of equilibrium.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeMap;

use linkgram::check::{self, Outcome};
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Refusal, Scene};
use linkgram::solve::solve;

use crate::common;

fn read(text: &str) -> Scene {
    scene::read(text, "governor.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refusal(text: &str) -> String {
    scene::read(text, "governor.json").unwrap_err().to_string()
}

fn answers(scene: &Scene) -> BTreeMap<String, Vec<f64>> {
    let solved = solve(scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(scene, &solved, &linkgram::solve::solve_analytically(scene));
    assert!(agreement.ok(), "{:?} {:?}", agreement.refused, agreement.disagreements());
    let told = agreement.compared.iter().map(|compared| {
        let value = match &compared.graphical.answer {
            Answer::Scalar { value, .. } => vec![*value],
            Answer::Vector { value, .. } => value.to_vec(),
            other => panic!("{}: {other:?}", compared.asked.name),
        };
        (compared.asked.name.clone(), value)
    });
    told.collect()
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

#[test]
fn the_books_governors_hold() {
    for stem in ["forces/s000-ch5-3a", "forces/s000-ch5-3b", "forces/s000-ch5-5a"] {
        let checked = check::check(&common::example(stem), 0.005);
        assert!(checked.ok, "{stem}: {:?}", checked.outcome);
    }
}

/// A ball on an arm of 5 m that hangs 4 m below the axis' pivot, 3 m out.
fn pendulum(ball: [f64; 2], omega: &str, find: &str) -> String {
    format!(
        r#"{{ "fixed": {{ "O": [0, 0] }}, "placed": {{ "B": [{}, {}] }}, "links": {{ "2": {{ "joins": ["O", "B"] }} }},
        "input": {{ "link": 2 }}, "gravity": {{}}, "masses": {{ "2": {{ "mass": 7, "at": "B" }} }},
        "spin": {{ "axis": {{ "through": [0, 8], "angle": 90 }}, "omega": {omega} }}, "find": [{find}] }}"#,
        ball[0], ball[1]
    )
}

/// Watt: ω² = g/h, whatever the mass and the arm; on either side of the axis.
#[test]
fn watts_governor_is_the_closed_form() {
    for x in [3.0, -3.0] {
        let found = answers(&read(&pendulum([x, -4.0], r#""?""#, r#""spin", "Fc(2)", "F(1,2)""#)));
        near(found["spin"][0], libm::sqrt(9.81 / 4.0));
        near(found["Fc(2)"][0], 7.0 * 9.81 / 4.0 * x);
        near(found["Fc(2)"][1], 0.0);
        near(found["F(1,2)"][0], -7.0 * 9.81 / 4.0 * x);
        near(found["F(1,2)"][1], 7.0 * 9.81);
        // At a given speed the arm needs what is left.
        let found = answers(&read(&pendulum(
            [x, -4.0],
            "2",
            r#""T(2)", "T(2).static", "T(2).inertia", "arm(Fc(2),O)""#,
        )));
        near(found["T(2)"][0], x * 7.0 * (9.81 - 4.0 * 4.0));
        near(found["T(2).static"][0], x * 7.0 * 9.81);
        near(found["T(2).inertia"][0], -x * 7.0 * 16.0);
        near(found["arm(Fc(2),O)"][0], 4.0);
    }
}

/// A ball above its pivot falls outward at every speed.
#[test]
fn what_falls_outward_has_no_speed() {
    let text = pendulum([3.0, 4.0], r#""?""#, r#""spin""#);
    let checked = check::check(&read(&text), 0.05);
    let Outcome::Refused { refusal, error } = checked.outcome else { panic!("it is solved") };
    assert_eq!(refusal, Some(Refusal::NoEquilibrium));
    assert!(error.to_string().contains("no speed"), "{error}");
    let expected = text.replacen('{', r#"{ "expect": "no-equilibrium", "#, 1);
    assert!(check::check(&read(&expected), 0.05).ok);
}

/// Nor are there forces of it, asked alone or beside the speed.
#[test]
fn what_has_no_speed_has_no_forces() {
    for find in [r#""Fc(2)""#, r#""F(1,2)""#, r#""spin", "Fc(2)", "F(1,2)""#] {
        let text = pendulum([3.0, 4.0], r#""?""#, find).replacen('{', r#"{ "expect": "no-equilibrium", "#, 1);
        let checked = check::check(&read(&text), 0.05);
        assert!(checked.ok, "{find}: {:?}", checked.outcome);
    }
}

/// Porter, arms of equal length from pivots on the axis: ω² = (m + M/2 (1 + q)) g / (m h), q = 1.
fn porter(more_of_sleeve: &str, find: &str) -> Scene {
    read(&format!(
        r#"{{ "fixed": {{ "O": [0, 0] }}, "placed": {{ "B": [3, -4], "S": [0, -8] }},
        "links": {{ "2": {{ "joins": ["O", "B"] }}, "3": {{ "joins": ["B", "S"] }} }},
        "slides": [ {{ "pin": "S", "block": 4, "on": {{ "link": 1, "through": "O", "angle": 90 }} {more_of_sleeve} }} ],
        "input": {{ "link": 2 }}, "gravity": {{}},
        "masses": {{ "2": {{ "mass": 5, "at": "B" }}, "4": {{ "mass": 30 }} }},
        "spin": {{ "axis": {{ "through": [0, 0], "angle": 90 }}, "omega": "?", "balls": 2, "sleeve": 4 }}, "find": [{find}] }}"#
    ))
}

#[test]
fn porters_governor_is_the_closed_form() {
    let found = answers(&porter("", r#""spin", "F(3,4)""#));
    near(found["spin"][0], libm::sqrt((5.0 + 30.0) * 9.81 / (5.0 * 4.0)));
    // One arm carries half the sleeve.
    near(found["F(3,4)"][1], 15.0 * 9.81);
    let found = answers(&porter(r#", "drag": 50"#, r#""spin(rising)", "spin(falling)""#));
    let speed = |sleeve: f64| libm::sqrt((5.0 * 9.81 + sleeve) / (5.0 * 4.0));
    near(found["spin(rising)"][0], speed(30.0 * 9.81 + 50.0));
    near(found["spin(falling)"][0], speed(30.0 * 9.81 - 50.0));
    // A drag has no sense while the sleeve rests.
    let scene = porter(r#", "drag": 50"#, r#""spin", "spin(rising)""#);
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    assert!(format!("{:?}", solved.answer(&scene, "spin")).contains("the sleeve rests"));
}

#[test]
fn what_governors_refuse() {
    let text = pendulum([3.0, -4.0], "2", r#""spin""#);
    assert!(refusal(&text).contains("no speed is sought"));
    assert!(refusal(&text.replace("\"spin\"]", "\"Fc(1)\"]")).contains("has no mass"));
    assert!(
        refusal(&text.replace("\"omega\": 2", "\"omega\": \"?\", \"balls\": 0")).contains("whole number")
    );
    let told = refusal(&pendulum([3.0, -4.0], r#""?""#, r#""T(2)""#));
    assert!(told.contains("spin") && told.contains("sought"), "{told}");
    assert!(refusal(&pendulum([3.0, -4.0], r#""?""#, r#""spin(rising)""#)).contains("no sleeve is named"));
    let without = text.replace(
        r#""masses": { "2": { "mass": 7, "at": "B" } },"#,
        r#""loads": [ { "on": 2, "torque": 3 } ],"#,
    );
    assert!(refusal(&without).contains("nothing has a mass"), "{}", refusal(&without));
}

/// Where the position of a governor has no speed of equilibrium for one of the two ways, there is no controlling force to
/// lead over the range, and no number of another column in its place: the axis lies aslant to the sleeve's guide.
#[test]
fn a_governor_without_a_speed_is_none() {
    for angle in [10, 30, 45, 90] {
        let axis = format!(r#""axis": {{ "through": [0, 0], "angle": {angle} }}"#);
        let scene = read(
            &r#"{ "units": { "length": "mm", "stiffness": "N/mm" }, "fixed": { "O": [110, 0] },
                "placed": { "B": [110, 120], "D": [30, 0], "S": [0, 0] },
                "links": { "2": { "joins": ["O", "B", "D"] }, "3": { "joins": ["S"] } },
                "slides": [
                    { "link": 3, "on": { "link": 1, "through": [0, 0], "angle": 90 }, "drag": 30 },
                    { "pin": "D", "block": 4, "on": { "link": 3, "through": "S", "turned": -90 } }
                ],
                "input": { "slide": 3 }, "masses": { "2": { "mass": 1.8, "at": "B" } },
                "springs": [{ "name": "k", "between": [{ "link": 3, "at": "S" }, { "link": 1, "at": [0, 150] }],
                    "stiffness": 18, "free": 200 }],
                "spin": { AXIS, "omega": "?", "balls": 2, "sleeve": 3 },
                "find": ["spin(rising)", "spin(falling)"] }"#
                .replace("AXIS", &axis),
        );
        let governed = linkgram::solve::governed(&scene.mechanism, None).unwrap();
        assert_eq!(governed.is_some(), angle == 90, "{angle}");
    }
}

#[test]
fn governors_are_drawn() {
    for stem in ["forces/s000-ch5-3a", "forces/s000-ch5-3b", "forces/s000-ch5-5a"] {
        let scene = common::example(stem);
        let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default());
        assert!(drawn.is_ok(), "{stem}: {}", drawn.err().unwrap().told(&scene));
    }
}

/// A spring governor as Hartnell's: the arm of the ball and the arm that lifts the sleeve are square to each other, the ball
/// straight above its pivot; with this drag on the sleeve.
fn hartnell(drag: &str, find: &str) -> Scene {
    read(&format!(
        r#"{{ "units": {{ "length": "mm", "stiffness": "N/mm" }}, "fixed": {{ "O": [90, 0] }},
        "placed": {{ "B": [90, 80], "D": [30, 0], "S": [0, 0] }},
        "links": {{ "2": {{ "joins": ["O", "B", "D"] }}, "3": {{ "joins": ["S"] }} }},
        "slides": [{{ "link": 3, "on": {{ "link": 1, "through": [0, 0], "angle": 90 }}{drag} }},
        {{ "pin": "D", "block": 4, "on": {{ "link": 3, "through": "S", "turned": -90 }} }}],
        "input": {{ "slide": 3 }}, "masses": {{ "2": {{ "mass": 1.5, "at": "B" }} }},
        "springs": [{{ "name": "k", "between": [{{ "link": 3, "at": "S" }}, {{ "link": 1, "at": [0, 100] }}],
        "stiffness": 12, "free": 150 }}],
        "spin": {{ "axis": {{ "through": [0, 0], "angle": 90 }}, "omega": "?", "balls": 2, "sleeve": 3 }},
        "find": [{find}] }}"#
    ))
}

#[test]
fn a_spring_pulls_whatever_the_sleeve_is_about_to_do() {
    // 12 N/mm and 50 mm too short; 25 N of drag on the sleeve, of which half counts.
    let found = answers(&hartnell(r#", "drag": 25"#, r#""spin(rising)", "spin(falling)", "spring(k)""#));
    near(found["spring(k)"][0], -600.0);
    let speed = |sleeve: f64| libm::sqrt(sleeve / 2.0 * 60.0 / 80.0 / (1.5 * 0.09));
    near(found["spin(rising)"][0], speed(625.0));
    near(found["spin(falling)"][0], speed(575.0));
}

/// Pins rub in the sense in which the sleeve is about to move, whatever is named as the input of a governor that rests. The force
/// of the sleeve touches the friction circle of D, the reaction at O its own: C h = F a' ± q √(F² + C²), with a' = 60 ± p.
#[test]
fn pins_rub_as_the_sleeve_is_about_to_move() {
    let [height, arm] = [80.0, 60.0];
    for input in [r#"{ "slide": 3 }"#, r#"{ "link": 2 }"#] {
        for [p, q] in [[2.0, 0.0], [0.0, 1.5], [2.0, 1.5]] {
            let text =
                hartnell(r#", "drag": 25"#, r#""spin(rising)", "spin(falling)""#).source.text().to_owned();
            let pins = format!(r#""pins": {{ "D": {{ "circle": {p} }}, "O": {{ "circle": {q} }} }}, "find""#);
            let text = text.replace(r#"{ "slide": 3 }"#, input).replace(r#""find""#, &pins);
            let found = answers(&read(&text));
            let speed = |sense: f64| {
                let force = (600.0 + sense * 25.0) / 2.0;
                let arm = arm + sense * p;
                let root = sense * q * libm::sqrt(height * height + arm * arm - q * q);
                let centrifugal = force * (arm * height + root) / (height * height - q * q);
                libm::sqrt(centrifugal / (1.5 * 0.09))
            };
            near(found["spin(rising)"][0], speed(1.0));
            near(found["spin(falling)"][0], speed(-1.0));
        }
    }
}

/// What a governor's range is, in the order in which it is told: r, mm.
fn parts(scene: &Scene, range: Option<[f64; 2]>) -> Vec<(&'static str, [f64; 2])> {
    let governed = linkgram::solve::governed(&scene.mechanism, range).unwrap().unwrap();
    let all = governed.parts.iter().chain(&governed.elsewhere);
    all.map(|part| (part.stability.name(), part.radii.map(|radius| 1e3 * radius))).collect()
}

#[test]
fn the_range_of_a_governor_ends_where_it_does() {
    // The sleeve goes up and down by 60 mm, the ball in and out by 80; 50 mm down the spring is free.
    let scene = hartnell("", r#""spin""#);
    let whole = parts(&scene, None);
    let within = parts(&scene, Some([-0.03, 0.03]));
    let radius = |lift: f64| 90.0 + 80.0 * lift / 60.0;
    let ends = |parts: &[(&str, [f64; 2])]| {
        let all = parts.iter().flat_map(|(_, radii)| *radii);
        [all.clone().fold(f64::INFINITY, f64::min), all.fold(0.0, f64::max)]
    };
    for (found, wanted) in ends(&within).iter().zip([radius(-30.0), radius(30.0)]) {
        near(*found, wanted);
    }
    for (found, wanted) in ends(&whole).iter().zip([radius(-50.0), radius(60.0)]) {
        near(*found, wanted);
    }
}

#[test]
fn the_stable_ranges_of_a_governor_are_roots_and_all_told() {
    // The arm of 250 mm at 40 mm from the axis, the bar of 220 mm to a sleeve 50 mm from it.
    let scene = read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O": [40, 0] }, "placed": { "B": [183.3941090877615, -204.78801107224794] },
        "links": { "2": { "joins": ["O", "B"] }, "3": { "joins": ["B", "S"], "length": 220 } }, "near": { "S": [50, -379.7337502620961] },
        "slides": [{ "pin": "S", "block": 4, "on": { "link": 1, "through": [50, 0], "angle": 90 } }], "input": { "link": 2 },
        "gravity": {}, "masses": { "2": { "mass": 4, "at": "B" }, "4": { "mass": 25 } },
        "spin": { "axis": { "through": [0, 0], "angle": 90 }, "omega": "?", "balls": 2, "sleeve": 4 }, "find": ["spin"] }"#,
    );
    // By hand: ω² = g (m tan a + M/2 (tan a + tan b)) / (m r), a of the arm and b of the bar from the axis; b from what the
    // bar goes sideways.
    let square = |degrees: f64| {
        let turn = degrees.to_radians();
        let (x, y) = (40.0 + 250.0 * libm::cos(turn), 250.0 * libm::sin(turn));
        let tan_a = (x - 40.0) / -y;
        let across: f64 = x - 50.0;
        let tan_b = across / libm::sqrt(220.0 * 220.0 - across * across);
        (x, 9810.0 * (4.0 * tan_a + 12.5 * (tan_a + tan_b)) / (4.0 * x))
    };
    let bisect = |mut low: f64, mut high: f64, is_low: &dyn Fn(f64) -> bool| {
        for _ in 0..200 {
            let middle = f64::midpoint(low, high);
            if is_low(middle) { low = middle } else { high = middle }
        }
        low
    };
    let zero = bisect(270.5, 272.0, &|at| square(at).1 < 0.0);
    let falls = |at: f64| square(at + 1e-3).1 < square(at - 1e-3).1;
    let least = bisect(238.0, 240.0, &|at| falls(at));
    let told = parts(&scene, None);
    let own = told[0];
    assert_eq!(own.0, "stable");
    near(own.1[0], square(zero).0);
    near(own.1[1], 270.0);
    // The other branches of the same assembly: 212.9 to 261 degrees, with the least speed at 239.02, and above the pivot.
    let turn = square(least).0.abs();
    let has = |kind: &str, at: f64, end: usize| {
        told.iter().any(|(name, radii)| *name == kind && (radii[end] - at).abs() < 1e-3)
    };
    assert!(has("unstable", turn, 1) || has("stable", turn, 0), "{turn} in {told:?}");
    assert!(told.len() >= 3, "{told:?}");
}

/// What drags on a sleeve that moves is a part of the force of its guide, whichever link is driven: half of it here, against
/// the motion, for one of two halves is drawn.
#[test]
fn the_force_on_a_moving_sleeve_has_its_drag() {
    let still = hartnell(r#", "drag": 25"#, r#""spin", "F(1,3)""#).source.text().to_owned();
    let inputs = [
        (r#"{ "slide": 3, "velocity": 10 }"#, 1.0),
        (r#"{ "slide": 3, "velocity": -10 }"#, -1.0),
        // The arm that lifts the sleeve lies to the left of its pivot.
        (r#"{ "link": 2, "omega": -0.5 }"#, 1.0),
        (r#"{ "link": 2, "omega": 0.5 }"#, -1.0),
    ];
    for (input, up) in inputs {
        let found = answers(&read(&still.replace(r#"{ "slide": 3 }"#, input)));
        let [x, y] = found["F(1,3)"][..] else { panic!("no force") };
        near(x, 0.0);
        near(y, -up * 12.5);
        near(found["spin"][0], libm::sqrt((600.0 + up * 25.0) / 2.0 * 60.0 / 80.0 / (1.5 * 0.09)));
    }
}
