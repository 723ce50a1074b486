//! Scenes stated by places: the same mechanism as one stated by dimensions, and the same answers.
//!
//! The truth of each is a closed form, or the same mechanism stated by its dimensions, with the places worked out
//! here by the addition of vectors and nothing else.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use crate::common;

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::solve::{solve, solve_analytically};
use linkgram::{report, sheet};

/// The answers of both solvers, SI units: coordinates of a vector, one number of a scalar.
fn answers(scene: &Scene) -> Vec<(String, [Vec<f64>; 2])> {
    let solved = solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{}", report::diagnose(scene, &error)));
    let state = solve_analytically(scene).unwrap_or_else(|error| panic!("{error}"));
    let numbers = |name: &str, answer: &Answer| match answer {
        Answer::Scalar { value, .. } => vec![*value],
        Answer::Vector { value, .. } => value.to_vec(),
        other => panic!("{name} is {other:?}"),
    };
    let asked = scene.mechanism.asked.iter().zip(&solved.solution.construction.answers);
    asked
        .map(|(asked, reading)| {
            let drawn = numbers(&asked.name, &reading.answer);
            let other = numbers(&asked.name, &state.answer(&asked.quantity));
            (asked.name.clone(), [drawn, other])
        })
        .collect()
}

/// That both solvers give these values, in SI units, to nine digits of the largest of their kind.
fn gives(text: &str, truth: &[(&str, Vec<f64>)]) {
    let answers = answers(&common::read(text));
    for (name, value) in truth {
        let kind = name.split('(').next();
        let alike = truth.iter().filter(|(other, _)| other.split('(').next() == kind);
        let size = alike.flat_map(|(_, v)| v).fold(0.0_f64, |size, v| size.max(v.abs()));
        let (_, found) = answers.iter().find(|(n, _)| n == name).unwrap_or_else(|| panic!("{name}?"));
        for (solver, found) in ["graphical", "analytic"].into_iter().zip(found) {
            let off = found.iter().zip(value).fold(0.0_f64, |off, (a, b)| off.max((a - b).abs()));
            assert!(off <= 1e-9 * size, "{solver} {name}: {found:?}, not {value:?}\n{text}");
        }
    }
}

/// That two statements of one mechanism have the same answers.
fn same(one: &str, other: &str) {
    let truth = answers(&common::read(one));
    let truth: Vec<(&str, Vec<f64>)> =
        truth.iter().map(|(name, [_, v])| (name.as_str(), v.clone())).collect();
    gives(one, &truth);
    gives(other, &truth);
}

fn at(angle: f64) -> [f64; 2] {
    [angle.to_radians().cos(), angle.to_radians().sin()]
}

/// A point at this distance and angle (degrees) from another.
fn polar([x, y]: [f64; 2], r: f64, angle: f64) -> [f64; 2] {
    let [c, s] = at(angle);
    [x + r * c, y + r * s]
}

/// ω × r and α × r − ω² r, for a point at this distance and angle from its pivot.
fn circling(r: f64, angle: f64, omega: f64, alpha: f64) -> [Vec<f64>; 2] {
    let [c, s] = at(angle);
    let v = vec![-omega * r * s, omega * r * c];
    let a = vec![-alpha * r * s - omega * omega * r * c, alpha * r * c - omega * omega * r * s];
    [v, a]
}

/// A third point off the line of a placed crank turns about the crank's pivot: v = ω r, a by its two parts.
#[test]
fn a_third_point_of_a_placed_crank() {
    for (order, drive) in
        [("\"O2\", \"A\", \"C\"", ""), ("\"C\", \"O2\", \"A\"", ""), ("\"A\", \"C\", \"O2\"", "")]
    {
        let o2 = [1.25, -0.5];
        let (a, c) = (polar(o2, 0.3, 40.0), polar(o2, 0.2, 95.0));
        let [va, aa] = circling(0.3, 40.0, -7.0, 11.0);
        let [vc, ac] = circling(0.2, 95.0, -7.0, 11.0);
        gives(
            &format!(
                r#"{{ "fixed": {{ "O2": {o2:?} }}, "placed": {{ "A": {a:?}, "C": {c:?} }},
                  "links": {{ "2": {{ "joins": [{order}] }} }},
                  "input": {{ "link": 2{drive}, "omega": -7, "alpha": 11 }},
                  "find": ["v(A)", "a(A)", "v(C)", "a(C)", "x(C)"] }}"#
            ),
            &[("v(A)", va), ("a(A)", aa), ("v(C)", vc), ("a(C)", ac), ("x(C)", c.to_vec())],
        );
    }
}

/// A slotted lever through a crank pin, stated by its two places: with and without a block. ω of the lever is the
/// crank pin's speed square to the lever over its distance.
#[test]
fn a_placed_slotted_lever() {
    let (o4, omega) = ([0.0, -0.25], 12.0);
    let a = polar([0.0, 0.0], 0.1, 50.0);
    let arm = [a[0] - o4[0], a[1] - o4[1]];
    let reach = arm[0].hypot(arm[1]);
    let c = polar(o4, 0.6, arm[1].atan2(arm[0]).to_degrees());
    let [va, _] = circling(0.1, 50.0, omega, 0.0);
    let rate = (arm[0] * va[1] - arm[1] * va[0]) / (reach * reach);
    let vc = vec![-rate * (c[1] - o4[1]), rate * (c[0] - o4[0])];
    for block in ["", ", \"block\": 3"] {
        gives(
            &format!(
                r#"{{ "fixed": {{ "O2": [0, 0], "O4": {o4:?} }}, "placed": {{ "A": {a:?}, "C": {c:?} }},
                  "links": {{ "2": {{ "joins": ["O2", "A"] }}, "4": {{ "joins": ["O4", "C"] }} }},
                  "slides": [{{ "pin": "A"{block}, "on": {{ "link": 4, "through": "O4", "toward": "C" }} }}],
                  "input": {{ "link": 2, "omega": {omega} }},
                  "find": ["omega(4)", "v(C)", "v(A)"] }}"#
            ),
            &[("omega(4)", vec![rate]), ("v(C)", vc.clone()), ("v(A)", va.clone())],
        );
    }
}

/// A trammel driven by its bar, stated by places: v of its ends is ω times the distance of the instant centre.
#[test]
fn a_placed_trammel_driven_by_its_bar() {
    let (length, angle, omega) = (0.1, 150.0, -4.0);
    let a = [0.0, length * at(angle - 180.0)[1].abs()];
    let b = [length * at(30.0)[0], 0.0];
    let g = [0.6 * a[0] + 0.4 * b[0] + 0.01, 0.6 * a[1] + 0.4 * b[1] + 0.02];
    // The instant centre is the corner of the rectangle with the origin, A and B.
    let centre = [b[0], a[1]];
    let about = |p: [f64; 2]| vec![-omega * (p[1] - centre[1]), omega * (p[0] - centre[0])];
    for order in [r#""A", "B", "G""#, r#""G", "B", "A""#] {
        gives(
            &format!(
                r#"{{ "placed": {{ "A": {a:?}, "B": {b:?}, "G": {g:?} }},
                  "links": {{ "3": {{ "joins": [{order}] }} }},
                  "slides": [
                    {{ "pin": "A", "block": 2, "on": {{ "link": 1, "through": [0, 0], "angle": 90 }} }},
                    {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, 0], "angle": 0 }} }}
                  ],
                  "input": {{ "link": 3, "omega": {omega} }},
                  "find": ["v(A)", "v(B)", "v(G)"] }}"#
            ),
            &[("v(A)", about(a)), ("v(B)", about(b)), ("v(G)", about(g))],
        );
    }
}

/// An oscillating cylinder whose rod is stated by places: the rod rides as placed.
#[test]
fn a_placed_rod_in_an_oscillating_cylinder() {
    let a = polar([0.0, 0.0], 0.04, 70.0);
    let o4 = [0.15, 0.02];
    let along = (o4[1] - a[1]).atan2(o4[0] - a[0]).to_degrees();
    // The cylinder's x-axis points to its rider's first joint, A, and the rod's x-axis along it.
    let e = polar(a, 0.1, along + 180.0);
    let scene = |rod: &str, placed: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": {o4:?} }}, {placed}
              "links": {{ "2": {{ "joins": ["O2", "A"], "length": 0.04 }},
                {rod}, "4": {{ "joins": ["O4"] }} }},
              "slides": [{{ "link": 3, "on": {{ "link": 4, "through": "O4" }} }}],
              "input": {{ "link": 2, "angle": 70, "omega": 10, "alpha": 3 }},
              "near": {{ {near} }},
              "find": ["v(E)", "a(E)", "omega(4)", "alpha(3)", "slip(A/4)", "x(E)"] }}"#,
            near = if placed.is_empty() { format!("\"E\": {e:?}") } else { String::new() }
        )
    };
    same(
        &scene(r#""3": { "joins": ["A", "E"], "length": 0.1 }"#, ""),
        &scene(r#""3": { "joins": ["A", "E"] }"#, &format!("\"placed\": {{ \"A\": {a:?}, \"E\": {e:?} }},")),
    );
}

/// Links that slide without turning on two guides and share a pin, of which one is stated by places.
#[test]
fn a_placed_rider_on_a_moving_guide() {
    let scene = common::example_text("pairs/links-on-two-guides");
    let mut dimensions: serde_json::Value = serde_json::from_str(&scene).unwrap();
    dimensions.as_object_mut().unwrap().remove("published");
    dimensions["find"] =
        serde_json::json!(["v(C)", "v(D)", "a(C)", "a(D)", "omega(4)", "alpha(5)", "x(C)", "x(D)"]);
    let truth = answers(&common::read(&dimensions.to_string()));
    let millimetres = |name: &str| {
        let (_, [place, _]) = truth.iter().find(|(n, _)| n == name).unwrap();
        vec![place[0] * 1e3, place[1] * 1e3]
    };
    let joins = |link: &str| -> Vec<String> {
        let joins = dimensions["links"][link]["joins"].as_array().unwrap();
        joins.iter().map(|j| j.as_str().unwrap().to_owned()).collect()
    };
    let find: Vec<String> = truth.iter().map(|(name, _)| name.clone()).collect();
    for link in ["4", "5"] {
        let mut places = dimensions.clone();
        let asked: Vec<String> = joins(link).iter().map(|j| format!("x({j})")).collect();
        places["find"] = serde_json::json!([find.clone(), asked].concat());
        let known = answers(&common::read(&places.to_string()));
        let mut stated = dimensions.clone();
        stated["links"][link] = serde_json::json!({ "joins": joins(link) });
        for joint in joins(link) {
            let (_, [at, _]) = known.iter().find(|(n, _)| *n == format!("x({joint})")).unwrap();
            stated["placed"][&joint] = serde_json::json!([at[0] * 1e3, at[1] * 1e3]);
            stated["near"].as_object_mut().map(|near| near.remove(&joint));
        }
        for slide in stated["slides"].as_array_mut().unwrap() {
            if slide["link"].as_u64().map(|n| n.to_string()).as_deref() == Some(link) {
                slide.as_object_mut().unwrap().remove("turned");
            }
        }
        let truth: Vec<(&str, Vec<f64>)> = truth.iter().map(|(n, [v, _])| (n.as_str(), v.clone())).collect();
        gives(&stated.to_string(), &truth);
    }
    assert!(millimetres("x(C)").iter().all(|x| x.is_finite()));
}

/// A swivelling guide that is driven without an angle stands as its rider's place tells: the crank pin's speed square
/// to the guide is ω times its distance from the guide's pivot.
#[test]
fn a_driven_guide_that_its_rider_directs() {
    let (o4, omega) = ([0.3, -0.1], 5.0);
    let a = polar([0.0, 0.0], 0.2, 110.0);
    let arm = [a[0] - o4[0], a[1] - o4[1]];
    let across = omega * (arm[0] * arm[0] + arm[1] * arm[1]);
    // v of A is square to the crank, and its part square to the guide is ω × arm: v · (−arm_y, arm_x) = ω arm².
    let [c, s] = at(110.0);
    let speed = across / (arm[1] * s + arm[0] * c);
    let va = vec![-speed * s, speed * c];
    for (guide, crank) in [("", ""), (", \"angle\": 140", ""), (", \"angle\": -35", ", \"length\": 0.2")] {
        gives(
            &format!(
                r#"{{ "fixed": {{ "O2": [0, 0], "O4": {o4:?} }}, "placed": {{ "A": {a:?} }},
                  "links": {{ "2": {{ "joins": ["O2", "A"]{crank} }}, "4": {{ "joins": ["O4"] }} }},
                  "slides": [{{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": "O4"{guide} }} }}],
                  "input": {{ "link": 4, "omega": {omega} }},
                  "find": ["v(A)", "omega(2)", "omega(4)"] }}"#
            ),
            &[("v(A)", va.clone()), ("omega(2)", vec![speed / 0.2]), ("omega(4)", vec![omega])],
        );
    }
}

/// A swivelling guide beside its joint meets its rider at the end further along its link's x-axis.
#[test]
fn a_swivelling_guide_beside_its_joint() {
    let (o4, a) = ([0.0, -2.0], at(35.0));
    let arm = [a[0] - o4[0], a[1] - o4[1]];
    let (reach, seen) = (arm[0].hypot(arm[1]), arm[1].atan2(arm[0]).to_degrees());
    for angle in [0.0_f64, 25.0, 60.0, 120.0, 200.0, -70.0] {
        for offset in [0.0_f64, 0.3, -0.5, 1.9] {
            // From the joint's foot the rider lies forward where the guide's direction has a part along x.
            let forward = (reach * reach - offset * offset).sqrt() * at(angle)[0].signum();
            let stands = seen - offset.atan2(forward).to_degrees() - angle;
            let stands = stands.rem_euclid(360.0).to_radians();
            let stands =
                if stands > std::f64::consts::PI { stands - 2.0 * std::f64::consts::PI } else { stands };
            gives(
                &format!(
                    r#"{{ "fixed": {{ "O2": [0, 0], "O4": {o4:?} }},
                      "links": {{ "2": {{ "joins": ["O2", "A"], "length": 1 }}, "4": {{ "joins": ["O4"] }} }},
                      "slides": [{{ "pin": "A", "block": 3,
                        "on": {{ "link": 4, "through": "O4", "angle": {angle}, "offset": {offset} }} }}],
                      "input": {{ "link": 2, "angle": 35, "omega": 2 }}, "find": ["angle(4)"] }}"#
                ),
                &[("angle(4)", vec![stands])],
            );
        }
    }
}

/// A gear that carries a guide beside its centre has the world's axes at this instant, in both solvers. B moves with
/// the guide's point under it square to the guide, so that the lever above the gear turns as fast as the gear.
#[test]
fn a_gear_that_carries_a_guide() {
    let dx = -(150.0_f64 * 150.0 - 145.0 * 145.0).sqrt();
    gives(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O3": [100, 0], "O5": [100, 200] },
          "links": { "2": { "joins": ["O2"] }, "3": { "joins": ["O3"] }, "5": { "joins": ["O5", "B"], "length": 150 } },
          "rolls": [{ "links": [2, 3], "centres": ["O2", "O3"], "radii": [40, 60] }],
          "slides": [{ "pin": "B", "block": 4, "on": { "link": 3, "through": [0, 55], "angle": 0 } }],
          "near": { "B": [60, 55] }, "input": { "link": 2, "omega": 3 },
          "find": ["omega(3)", "omega(5)", "v(B)"] }"#,
        &[("omega(3)", vec![-2.0]), ("omega(5)", vec![-2.0]), ("v(B)", vec![-0.29, -2.0 * dx * 1e-3])],
    );
}

/// A cylinder that is driven by its length: every point of the boom, by the law of cosines and its derivatives.
#[test]
fn the_boom_of_a_driven_cylinder() {
    let (boom, length, v, a) = (0.1_f64, 0.14_f64, 0.01, 0.005);
    let (base, slope) = (0.15_f64.hypot(0.02), (-0.02_f64).atan2(0.15));
    let cos = (boom * boom + base * base - length * length) / (2.0 * boom * base);
    let angle = cos.acos();
    let sin = angle.sin();
    // boom · base · sin φ · φ' = L L', and its derivative.
    let omega = length * v / (boom * base * sin);
    let alpha = ((v * v + length * a) / (boom * base) - cos * omega * omega) / sin;
    let turned = (angle + slope).to_degrees();
    let [vc, ac] = circling(0.18, turned, omega, alpha);
    let [vd, ad] = circling(0.12_f64.hypot(0.03), turned + 0.03_f64.atan2(0.12).to_degrees(), omega, alpha);
    gives(
        r#"{ "fixed": { "O2": [0, 0], "O4": [0.15, -0.02] },
          "links": { "2": { "joins": ["O2", "A", "C", "D"],
              "shape": { "O2": [0, 0], "A": [0.1, 0], "C": [0.18, 0], "D": [0.12, 0.03] } },
            "3": { "joins": ["A", "P"], "length": 0.03 }, "4": { "joins": ["O4"] } },
          "slides": [{ "link": 3, "turned": 180, "on": { "link": 4, "through": "O4" } }],
          "near": { "A": [0.05, 0.085] },
          "input": { "slide": 3, "at": 0.14, "velocity": 0.01, "acceleration": 0.005 },
          "find": ["v(C)", "a(C)", "v(D)", "a(D)", "omega(2)", "alpha(2)"] }"#,
        &[
            ("v(C)", vc),
            ("a(C)", ac),
            ("v(D)", vd),
            ("a(D)", ad),
            ("omega(2)", vec![omega]),
            ("alpha(2)", vec![alpha]),
        ],
    );
}

/// The hint of the pin at which a dyad closes comes before that of a coupler point, in both solvers; a coupler point
/// chooses where the pin has none.
#[test]
fn the_hint_of_a_pin_outvotes_that_of_a_coupler_point() {
    let scene = |near: &str| {
        format!(
            r#"{{ "fixed": {{ "O2": [0, 0], "O4": [4, 0] }},
              "links": {{ "2": {{ "joins": ["O2", "A"], "length": 1 }},
                "3": {{ "joins": ["A", "B", "C"], "sides": [4, 2, 3] }}, "4": {{ "joins": ["O4", "B"], "length": 3 }} }},
              "near": {{ {near} }}, "input": {{ "link": 2, "angle": 60, "omega": 2 }}, "find": ["x(B)"] }}"#
        )
    };
    // Above the line from A to O4, and below it: circles of radius 4 and 3 about [1/2, √3/2] and [4, 0].
    let (ax, ay) = (0.5, 0.75_f64.sqrt());
    let (dx, dy) = (4.0 - ax, -ay);
    let d2 = dx * dx + dy * dy;
    let along = (d2 + 16.0 - 9.0) / (2.0 * d2);
    let across = (16.0 / d2 - along * along).sqrt();
    let place = |side: f64| vec![ax + along * dx - side * across * dy, ay + along * dy + side * across * dx];
    for (near, side) in [
        (r#""B": [3.5, 0.2]"#, 1.0),
        (r#""B": [3.5, 0.2], "C": [1, -30]"#, 1.0),
        (r#""B": [2, -1], "C": [1, 30]"#, -1.0),
        (r#""C": [1, -30]"#, -1.0),
        (r#""C": [1, 30]"#, 1.0),
    ] {
        gives(&scene(near), &[("x(B)", place(side))]);
    }
}

/// One placed point and nothing else with a length: its digits may miss its guide by rounding.
#[test]
fn one_placed_point_may_miss_its_guide_by_rounding() {
    let half = 3.0_f64.sqrt() / 2.0;
    gives(
        r#"{ "placed": { "D": [1.7320508, 1.0] }, "links": { "2": { "joins": ["D"] } },
          "slides": [{ "link": 2, "on": { "link": 1, "through": [0, 0], "angle": 30 } }],
          "input": { "slide": 2, "velocity": 3 }, "find": ["v(D)"] }"#,
        &[("v(D)", vec![3.0 * half, 1.5])],
    );
}

/// What contradicts itself only when the skeleton stands is refused, and by how much it misses is said.
#[test]
fn places_that_contradict_what_follows_are_refused() {
    for (text, told) in [
        (
            // The guide has the world's axes and passes the pin by.
            r#"{ "fixed": { "O2": [0, 0], "O4": [0, -2] },
              "links": { "2": { "joins": ["O2", "A"], "length": 1 }, "4": { "joins": ["O4"] } },
              "slides": [{ "pin": "A", "block": 3, "on": { "link": 4, "through": [0.3, 0.1], "angle": 40 } }],
              "input": { "link": 2, "angle": 35, "omega": 2 }, "find": ["omega(4)"] }"#,
            "are missing at A",
        ),
        (
            // A follows from the input, and B is placed farther from it than the rod is long.
            r#"{ "fixed": { "O2": [0, 0], "O4": [4, 0] }, "placed": { "B": [3.6, 2.9732137494637] },
              "links": { "2": { "joins": ["O2", "A"], "length": 1 }, "3": { "joins": ["A", "B"], "length": 3.5 },
                "4": { "joins": ["O4", "B"], "length": 3 } },
              "input": { "link": 2, "angle": 60, "omega": 2 }, "find": ["omega(4)"] }"#,
            "but link 3 makes it 3.5 m",
        ),
        (
            // By its guide on link 2 the disc points up, by that on link 4 down.
            r#"{ "fixed": { "O2": [0, 0], "O4": [20, 0] }, "placed": { "A": [0, 60], "C": [0, 0], "B": [-30, 0] },
              "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["C"] }, "4": { "joins": ["O4", "B"] } },
              "slides": [{ "link": 3, "on": { "link": 2, "through": "O2", "toward": "A" } },
                { "link": 3, "turned": 90, "on": { "link": 4, "through": "O4", "toward": "B" } }],
              "input": { "link": 2, "omega": -39 }, "find": ["v(C)"] }"#,
            "link 3 stands turned by half a turn against the guide on link",
        ),
        (
            // A guide of one joint points to its rider, and this one has it behind.
            r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [80, -40] }, "near": { "A": [71, 29] },
              "links": { "2": { "joins": ["O2", "A"], "length": 76.2 }, "3": { "joins": ["A"] },
                "4": { "joins": ["O4"] } },
              "slides": [{ "link": 3, "on": { "link": 4, "through": "O4", "angle": 0 } }],
              "input": { "slide": 3, "velocity": 25, "at": -70.71 }, "find": ["v(A)"] }"#,
            "the guide of link 4 leads away from what rides on it",
        ),
    ] {
        let message = match linkgram::scene::read(text, "test.json") {
            Err(error) => error.to_string(),
            Ok(scene) => {
                assert!(solve_analytically(&scene).is_err());
                match solve(&scene, Extent::Asked, sheet::scale::for_scene) {
                    Err(error) => report::diagnose(&scene, &error).to_string(),
                    Ok(_) => panic!("drawn: {text}"),
                }
            }
        };
        assert!(message.contains(told), "{message}");
    }
}

/// A point of the rod at whose end a wheel rolls inside a ring, stated by dimensions and a hint: found with the rod.
#[test]
fn a_point_of_the_rod_of_a_rolling_wheel() {
    // The wheel's centre E runs on a circle of radius 60 about F and is 38 from B.
    let (b, f) = ([0.02, 0.01], [0.0, 0.05]);
    let scene = |near: &str| {
        format!(
            r#"{{ "fixed": {{ "F": {f:?}, "O": [0, 0] }},
              "links": {{ "2": {{ "joins": ["O", "B"], "shape": {{ "O": [0, 0], "B": {b:?} }} }},
                "5": {{ "joins": ["B", "E", "G"], "sides": [0.038, 0.028, 0.056] }}, "4": {{ "joins": ["E"] }} }},
              "rolls": [{{ "links": [1, 4], "centres": ["F", "E"], "radii": [0.083, 0.143], "internal": true }}],
              "near": {{ {near} }}, "input": {{ "link": 2, "angle": 26.56505117707799, "omega": 1 }},
              "find": ["x(E)", "x(G)", "omega(5)"] }}"#
        )
    };
    let answers = answers(&common::read(&scene(r#""E": [0.05, 0.0]"#)));
    let place = |name: &str| {
        let (_, [drawn, other]) = answers.iter().find(|(n, _)| n == name).unwrap();
        assert!((drawn[0] - other[0]).abs() + (drawn[1] - other[1]).abs() < 1e-14, "{name}");
        drawn.clone()
    };
    let apart = |p: &[f64], q: &[f64]| (p[0] - q[0]).hypot(p[1] - q[1]);
    let (e, g) = (place("x(E)"), place("x(G)"));
    for (drawn, stated) in
        [(apart(&e, &f), 0.06), (apart(&e, &b), 0.038), (apart(&g, &e), 0.028), (apart(&g, &b), 0.056)]
    {
        assert!((drawn - stated).abs() < 1e-14, "{drawn}, not {stated}");
    }
}

/// Two cranks, each driven for itself, whose links have no other point that moves than what is placed: the centre of
/// one against the other divides the line of their pivots inversely as their angular velocities.
#[test]
fn the_centre_of_two_links_driven_apart() {
    let (p, q, [first, second]) = ([0.0, 0.0], [0.3, 0.1], [3.0, -5.0]);
    // ω₂ (C − p) = ω₃ (C − q).
    let centre: Vec<f64> = (0..2).map(|k| (first * p[k] - second * q[k]) / (first - second)).collect();
    for joins in [r#""C", "B""#, r#""B", "C""#] {
        gives(
            &format!(
                r#"{{ "fixed": {{ "A": {p:?}, "C": {q:?} }}, "placed": {{ "D": [0.1, 0.2], "B": [0.2, 0.3] }},
                  "links": {{ "2": {{ "joins": ["A", "D"] }}, "3": {{ "joins": [{joins}] }} }},
                  "inputs": [{{ "link": 2, "omega": {first} }}, {{ "link": 3, "omega": {second} }}],
                  "find": ["I(2,3)"] }}"#
            ),
            &[("I(2,3)", centre.clone())],
        );
    }
}

/// A wheel at the end of a rod, on either side of its line: where its centre has no hint, that of another point of
/// the rod tells the side. An upright crank 0.1 high, the line through its pivot: the rod's length sets F.
#[test]
fn a_point_of_its_rod_tells_the_side_on_which_a_wheel_rolls() {
    let (b, radius): ([f64; 2], f64) = ([0.0, 0.1], 0.05);
    for side in [1.0, -1.0] {
        let f = [0.2, side * radius];
        let rod = [f[0] - b[0], f[1] - b[1]];
        let length = rod[0].hypot(rod[1]);
        // G stands 0.06 square to the middle of the rod, on its left.
        let g: Vec<f64> =
            vec![b[0] + rod[0] / 2.0 - 0.06 * rod[1] / length, b[1] + rod[1] / 2.0 + 0.06 * rod[0] / length];
        let near = [g[0] + 0.002, g[1] - 0.001];
        gives(
            &format!(
                r#"{{ "fixed": {{ "A": [0, 0] }},
                  "links": {{ "3": {{ "joins": ["A", "B"], "length": 0.1 }},
                    "2": {{ "joins": ["B", "F", "G"],
                      "shape": {{ "B": [0, 0], "F": [{length}, 0], "G": [{}, 0.06] }} }},
                    "5": {{ "joins": ["F"] }} }},
                  "rolls": [{{ "links": [5, 1], "line": {{ "link": 1, "through": "A", "angle": 0 }},
                    "centre": "F", "radius": {radius} }}],
                  "near": {{ "G": {near:?} }},
                  "input": {{ "link": 3, "angle": 90, "omega": 2 }}, "find": ["x(G)", "x(F)"] }}"#,
                length / 2.0
            ),
            &[("x(G)", g), ("x(F)", f.to_vec())],
        );
    }
}

/// A link that slides on the frame and carries an arc guide whose centre is a placed point of it: that point, the
/// frame's guide and the arc say more than is needed, and none of them how the link points; its ride does.
#[test]
fn an_arc_about_a_placed_point_of_a_link_that_slides() {
    let scene = |given: &str| {
        format!(
            r#"{{ "fixed": {{ "A": [0, 0] }}, {given}
              "links": {{ "2": {{ "joins": ["A", "B"], "length": 0.5 }},
                "3": {{ "joins": ["C", "D"], "line": [0, 0.6] }} }},
              "slides": [
                {{ "pin": "B", "block": 4, "on": {{ "link": 3, "centre": "D", "radius": 1 }} }},
                {{ "link": 3, "turned": 90, "on": {{ "link": 1, "through": [0, 0], "angle": 0 }} }}],
              "input": {{ "link": 2, "angle": 90, "omega": 2, "alpha": 3 }},
              "find": ["v(D)", "a(D)", "x(D)", "omega(4)"] }}"#
        )
    };
    // B at (0, 0.5); D at height 0.6, one away from B.
    let d = [(1.0_f64 - 0.01).sqrt(), 0.6];
    // x_D = x_B + √(1 − (0.6 − y_B)²) with v_B = (−1, 0).
    gives(
        &scene(&format!(r#""placed": {{ "D": {d:?} }},"#)),
        &[("v(D)", vec![-1.0, 0.0]), ("x(D)", d.to_vec())],
    );
    same(
        &scene(&format!(r#""near": {{ "D": {d:?} }},"#)),
        &scene(&format!(r#""placed": {{ "D": {d:?} }},"#)),
    );
}

/// A link that is driven for itself and depends on another driven one: its third point, in line with the others, has the
/// velocity of its own turning.
#[test]
fn a_driven_link_on_a_driven_link() {
    let truth = |w2: f64, w3: f64, e2: f64, e3: f64| {
        let turned =
            |[x, y]: [f64; 2], w: f64, e: f64| ([-w * y, w * x], [-e * y - w * w * x, e * x - w * w * y]);
        let (va, aa) = turned([3.0, 4.0], w2, e2);
        let (vc, ac) = turned([7.0 * 0.6, -7.0 * 0.8], w3, e3);
        let sum = |a: [f64; 2], b: [f64; 2]| vec![a[0] + b[0], a[1] + b[1]];
        vec![("v(C)", sum(va, vc)), ("a(C)", sum(aa, ac)), ("v(A)", va.to_vec()), ("a(A)", aa.to_vec())]
    };
    let inputs = r#""inputs": [ { "link": 2, "omega": 2, "alpha": -3 }, { "link": 3, "omega": -5, "alpha": 7 } ],
        "find": ["v(C)", "a(C)", "v(A)", "a(A)"]"#;
    let places = r#""placed": { "A": [3, 4], "B": [4.8, 1.6], "C": [7.2, -1.6] }"#;
    let truth = truth(2.0, -5.0, -3.0, 7.0);
    for dimensions in
        ["", r#", "line": [0, 3, 7]"#, r#", "shape": { "A": [1, 1], "B": [4, 1], "C": [8, 1] }"#]
    {
        let text = format!(
            r#"{{ "fixed": {{ "O": [0, 0] }}, {places},
                "links": {{ "2": {{ "joins": ["O", "A"] }}, "3": {{ "joins": ["A", "B", "C"]{dimensions} }} }}, {inputs} }}"#
        );
        gives(&text, &truth);
    }
}

/// The crank pin A stands at (30, 40) on a slotted lever about O4 (0, −80), 150 long: whatever drives, and however the place
/// of A is said, ω₂ is 20 |O4A| / 2400 by the slide, 2 · |O4A|² / 5700 by the lever.
#[test]
fn a_stated_pin_counts_as_a_placed_one_on_a_slot_with_a_free_end() {
    let scene = |place: &str, input: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -80] }},
                "links": {{ "2": {{ "joins": ["O2", "A"] }}, "4": {{ "joins": ["O4", "D"], "length": 150 }} }},
                "slides": [ {{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": "O4", "toward": "D" }} }} ],
                "near": {{ "D": [36, 66], "A": [31, 41] }}, {place}, "input": {input}, "find": ["omega(2)", "omega(4)"] }}"#
        )
    };
    let reach = (30.0_f64 * 30.0 + 120.0 * 120.0).sqrt();
    // v(A) = ω₂ (−40, 30): along the lever 2400 ω₂ / |O4A|, square to it 5700 ω₂ / |O4A|.
    let by_slide = 20.0 * reach / 2400.0;
    let placed = r#""placed": { "A": [30, 40] }"#;
    let polar = r#""where": { "A": { "from": "O2", "distance": 50, "direction": "53.13010235415598 deg" } }"#;
    for place in [placed, polar] {
        let lever = r#"{ "link": 4, "omega": 2, "angle": 75.96375653207353 }"#;
        gives(
            &scene(place, lever),
            &[("omega(2)", vec![2.0 * reach * reach / 5700.0]), ("omega(4)", vec![2.0])],
        );
        let slide = r#"{ "slide": 3, "velocity": 20 }"#;
        let turning = by_slide * 5700.0 / (reach * reach);
        gives(&scene(place, slide), &[("omega(2)", vec![by_slide]), ("omega(4)", vec![turning])]);
    }
    // The distance is 123.693…: what is written of it differs by rounding, and is the same fact.
    for at in ["123.6932", "123.69317"] {
        let slide = format!(r#"{{ "slide": 3, "velocity": 20, "at": {at} }}"#);
        gives(&scene(placed, &slide), &[("omega(2)", vec![by_slide])]);
    }
    let error =
        linkgram::scene::read(&scene(placed, r#"{ "slide": 3, "velocity": 20, "at": 124.5 }"#), "slot.json");
    let text = error.unwrap_err().to_string();
    assert!(text.contains("A is placed") && text.contains("`at` of the driven slides[0]"), "{text}");
}

/// The order of joints, and of sliding pairs, says nothing.
#[test]
fn what_is_named_first_does_not_matter() {
    let boom = |joins: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O3": [50, -20] }},
                "placed": {{ "A": [60, 50], "R": [55.757359312880716, 20.301515190165006] }},
                "links": {{ "2": {{ "joins": [{joins}], "shape": {{ "O2": [0, 0], "A": [60, 50], "B": [100, 70] }} }},
                    "3": {{ "joins": ["O3", "Q"], "length": 20 }}, "4": {{ "joins": ["A", "R"] }} }},
                "slides": [ {{ "link": 4, "on": {{ "link": 3, "through": "O3", "toward": "Q" }} }} ],
                "near": {{ "Q": [52.8, -0.2], "B": [100, 70] }}, "input": {{ "slide": 4, "velocity": 10 }},
                "find": ["omega(2)", "v(B)", "omega(3)"] }}"#
        )
    };
    same(&boom(r#""O2", "A", "B""#), &boom(r#""O2", "B", "A""#));
    let lever = |first: &str, second: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -80] }}, "placed": {{ "A": [30, 40] }},
                "links": {{ "2": {{ "joins": ["O2", "A"] }}, "4": {{ "joins": ["O4"] }} }},
                "slides": [ {first}, {second}, {{ "pin": "P", "block": 6, "on": {{ "link": 1, "through": [0, 100] }} }} ],
                "near": {{ "P": [45, 100] }}, "input": {{ "slide": 3, "velocity": 10 }},
                "find": ["omega(4)", "v(P)"] }}"#
        )
    };
    let of_pin = r#"{ "pin": "A", "block": 3, "on": { "link": 4, "through": "O4" } }"#;
    let further = r#"{ "pin": "P", "block": 5, "on": { "link": 4, "through": "O4" } }"#;
    same(&lever(of_pin, further), &lever(further, of_pin));
}

/// Places tell how a yoke stands, and how a disc stands whose rider is driven, though lengths are stated as well.
#[test]
fn places_tell_what_rides_as_placed() {
    let yoke = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O3": [0, 70] },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["O3", "K"] }, "4": { "joins": ["C", "D"], "length": 90 } },
        "slides": [ { "link": 3, "on": { "link": 4, "through": "C", "angle": 0 } },
            { "pin": "A", "block": 5, "on": { "link": 4, "through": "C", "angle": 80 } } ],
        "inputs": [ { "link": 2, "omega": "10 rad/s cw", "alpha": 4 }, { "link": 3, "omega": "2 rad/s ccw", "alpha": 3 } ],
        "placed": { "A": [20.000000000000004, 34.64101615137754], "K": [24.6201938253052, 74.34120444167326],
            "C": [20.000000000000007, 73.5265396141693], "D": [108.63269777109872, 89.15487560419302] },
        "find": ["omega(4)", "alpha(4)"] }"#;
    gives(yoke, &[("omega(4)", vec![2.0]), ("alpha(4)", vec![3.0])]);
    let oldham = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [40, 20] },
        "placed": { "X": [15, 25], "E": [-20, 50] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["X", "E"] } },
        "slides": [ { "link": 3, "on": { "link": 2, "through": "O2", "toward": "A" } },
            { "pin": "O4", "on": { "link": 3, "through": [40, 20], "angle": 150 } } ],
        "near": { "A": [31, 51] }, "input": { "link": 3, "omega": 1 }, "find": ["omega(2)"] }"#;
    gives(oldham, &[("omega(2)", vec![1.0])]);
}

/// A segment is seen at the same angle in whatever unit, and from more than half a turn as from the rest of it.
#[test]
fn a_reflex_angle_is_seen_from_the_other_side() {
    let scene = |unit: &str, at: &str, along: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm", "angle": "{unit}" }}, "fixed": {{ "O2": [0, 0], "O4": [80, -10] }},
                "where": {{ "A": [ {{ "sees": ["O4", "O2"], "at": {at} }}, {{ "on": {{ "through": [20, 0], "angle": {along} }} }} ] }},
                "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"], "length": 70 }},
                    "4": {{ "joins": ["O4", "B"], "length": 60 }} }},
                "near": {{ "A": [20, 40], "B": [85, 50] }}, "input": {{ "link": 2, "omega": 2 }}, "find": ["x(A)", "omega(4)"] }}"#
        )
    };
    let degrees = 4.943466_f64.to_degrees();
    same(&scene("deg", &degrees.to_string(), "90"), &scene("rad", "4.943466", "1.5707963267948966"));
}

/// The bar of a cross slide is found by trial where link 30 lies just half a turn on: at the seam of the trials.
#[test]
fn a_group_that_closes_at_half_a_turn_is_found() {
    let cross = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [-10, -10] },
        "near": { "A": [20, 50], "B": [70, -20], "K": [30, -10] },
        "links": { "30": { "joins": ["K", "O2"], "length": 40 },
            "24": { "joins": ["B", "A"], "length": 86.02325267042627 } },
        "slides": [ { "pin": "A", "block": 34, "on": { "link": 30, "through": [10, 0], "angle": 90 } },
            { "pin": "B", "block": 5, "on": { "link": 30, "through": [0, 10], "angle": 0 } } ],
        "inputs": [ { "link": 24, "angle": 125.53767779197437, "omega": 15.67 },
            { "slide": 5, "at": -40, "velocity": -13.3, "acceleration": -300 } ],
        "find": ["x(A)", "x(B)"] }"#;
    gives(cross, &[("x(A)", vec![0.020, 0.050]), ("x(B)", vec![0.070, -0.020])]);
}

/// What only dimensions make known is found after the stated places, none of which is checked by it. A stands above O2 and B
/// at 120 mm on the x-axis, 130 mm from A (5 : 12 : 13); B slides at 100 mm/s, and A along x as fast.
#[test]
fn a_stated_place_is_not_checked_by_what_is_found_later() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] }, "placed": { "E": [200, 0] },
        "where": { "A": { "from": "O2", "distance": 50, "direction": 90 },
                   "B": [{ "from": "A", "distance": 130 }, { "on": { "through": [0, 0] } }] },
        "near": { "B": [120, 0] },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"], "length": 130 },
                   "4": { "joins": ["B", "E"], "length": 80 } },
        "slides": [{ "link": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
        "input": { "slide": 4, "velocity": 100 }, "find": ["v(B)", "v(A)", "omega(2)"] }"#;
    // A moves along x; the part of both velocities along AB is one.
    gives(scene, &[("v(B)", vec![0.1, 0.0]), ("v(A)", vec![0.1, 0.0]), ("omega(2)", vec![-2.0])]);
}

/// Loci alone, with no point that is given: a trammel with its bar of 100 mm, A at 60 mm on the y-axis, B at 80 mm on the
/// x-axis. The bar turns at 4 rad/s about where the normals meet, (80, 60).
#[test]
fn loci_need_no_given_point() {
    let scene = r#"{ "units": { "length": "mm" },
        "where": { "A": [{ "on": { "through": [0, 0], "angle": 90 } }, { "on": { "through": [10, 60], "angle": 0 } }],
                   "B": [{ "from": "A", "distance": 100 }, { "on": { "link": 1, "through": [0, 0] } }] },
        "near": { "B": [80, 0] }, "links": { "3": { "joins": ["A", "B"] } },
        "slides": [{ "pin": "A", "block": 2, "on": { "link": 1, "through": [0, 0], "angle": 90 } },
                   { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, 0], "angle": 0 } }],
        "input": { "link": 3, "omega": 4 }, "find": ["v(A)", "v(B)"] }"#;
    gives(scene, &[("v(A)", vec![0.0, -0.32]), ("v(B)", vec![0.24, 0.0])]);
}

/// A piston placed at (140, −15), a rod of 130 and a distance of 140.00001 along the guide: one fact but for rounding.
/// v(B) − v(A) is square to the rod (120, −50): 1200 + 5200 ω₂ = 0.
#[test]
fn a_distance_along_the_guide_that_repeats_a_place() {
    let piston = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0] }, "placed": { "A": [20, 35], "B": [140, -15] },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"], "length": 130 } },
        "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": [0, -15] } } ],
        "input": { "slide": "B", "at": 140.00001, "velocity": 10 }, "find": ["omega(2)", "x(B)"] }"#;
    gives(piston, &[("omega(2)", vec![-1200.0 / 5200.0]), ("x(B)", vec![0.140, -0.015])]);
}

/// A bar from A through a pin at (120, 30) to E, which is read 0.03 beside its line with a room of 0.05: ω₃ is −1 rad/s
/// (A moves at 150 mm/s square to the bar, 100 mm before the pin). Read three rooms beside it, E contradicts the pin.
#[test]
fn a_place_contradicts_within_its_room_only() {
    let bar = |y: &str| {
        format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [120, 30] }},
            "placed": {{ "A": [20, 30], "E": {{ "at": [130, {y}], "within": "0.05 mm" }} }},
            "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "E"] }} }},
            "slides": [{{ "pin": "O4", "block": 4, "on": {{ "link": 3, "through": "A", "toward": "E" }} }}],
            "input": {{ "link": 2, "omega": 5 }}, "find": ["omega(3)"] }}"#
        )
    };
    let scene = common::read(&bar("30.03"));
    let (_, found) = answers(&scene).remove(0);
    // A at (20, 30) moves with (−150, 100) mm/s; the part square to the bar turns it about the pin: −100/100.
    found.iter().for_each(|solver| assert!((solver[0] + 1.0).abs() < 2e-3, "{solver:?}"));
    let scene = common::read(&bar("30.15"));
    assert!(solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).is_err());
}

/// Both solvers confirm each other, and no bound passes this part of its number.
fn confirmed(text: &str, part: f64) {
    let scene = common::read(text);
    let solved = solve(&scene, Extent::Asked, sheet::scale::for_scene);
    let solved = solved.unwrap_or_else(|error| panic!("{}\n{text}", report::diagnose(&scene, &error)));
    let agreement = linkgram::check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{} of the bounds, {:?}\n{text}", agreement.worst_ratio(), agreement.refused);
    for (asked, reading) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
        let (size, bound) = match reading.answer {
            Answer::Scalar { value, bound } => (value.abs(), bound),
            Answer::Vector { value, bound } => (value[0].hypot(value[1]), bound),
            ref other => panic!("{} is {other:?}", asked.name),
        };
        assert!(bound <= part * size, "{}: {bound:e} of {size:e}\n{text}", asked.name);
    }
}

/// Davis's steering gear, an Oldham coupling, a slotted lever on a coupler: places of eight digits beside dimensions and
/// guides of eight digits. What a riding link's direction contradicts counts as well, and both solvers carry it into their
/// bounds; where a long lever magnifies it that is no refusal.
#[test]
fn places_of_eight_digits_beside_dimensions() {
    let davis = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [-66.528023, 0], "O3": [66.528023, 0] },
        "placed": { "A": [-73.874269, 59.267609], "E2": [-76.385176, 79.524956], "B": [58.312342, 59.267609],
                    "E3": [53.776911, 91.986037] },
        "links": { "4": { "joins": ["A", "B"], "shape": { "A": [33.790411, -9.6880185], "B": [-82.926838, 52.363444] } },
                   "2": { "joins": ["O2", "E2"] }, "3": { "joins": ["O3", "E3"], "length": 92.865612 } },
        "slides": [
          { "link": 4, "turned": -152.00314, "on": { "link": 1, "through": [0, 64.320078], "offset": -5.0524694 } },
          { "pin": "A", "block": 5, "on": { "link": 2, "through": "O2", "toward": "E2" } },
          { "pin": "B", "block": 6, "on": { "link": 3, "through": "O3", "toward": "E3" } }],
        "input": { "slide": 4, "velocity": 96.86, "acceleration": 285.4 },
        "find": ["v(B)", "v(E3)", "omega(6)", "alpha(6)", "I(1,6)", "I(3,4)"] }"#;
    let oldham = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [23.803194, 9.3944032] },
        "placed": { "A": [17.566289, 46.630768], "E": [55.064198, 43.229661], "C": [7.4869058, 19.874441],
                    "B": [-9.8855598, 31.032866] },
        "links": { "2": { "joins": ["O2", "A"] },
          "3": { "joins": ["C", "E"], "shape": { "C": [14.987512, -45.983689], "E": [-37.571475, -52.811417] } },
          "4": { "joins": ["O4", "B"], "shape": { "O4": [-9.1601292, -15.569302], "B": [28.095043, -0.89935418] } } },
        "slides": [
          { "link": 3, "turned": 129.38625, "on": { "link": 2, "through": "O2", "toward": "A" } },
          { "link": 3, "turned": 51.457193, "on": { "link": 4, "through": "O4", "angle": 21.493003 } }],
        "input": { "link": 4, "omega": 11.045 },
        "find": ["v(C@2)", "a(C@2)", "v(C@4)", "a(C@4)", "v(E)", "omega(2)"] }"#;
    let slotted = r#"{ "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [111.93229, -2.5342002], "O5": [143.81866, 149.68258] },
        "placed": { "H": [-2.0907876, 86.437135], "A": [-14.44112, 38.515769], "C": [49.770554, 108.91679],
                    "B": [90.916686, 87.382861], "J": [-52.146113, 163.82169] },
        "links": { "2": { "joins": ["O2", "A"] },
          "3": { "joins": ["A", "B", "C"], "sides": [116.13897, 46.440437, 95.28611] }, "4": { "joins": ["O4", "B"] },
          "5": { "joins": ["O5", "H"], "length": 159.02689 }, "7": { "joins": ["H", "J"] } },
        "slides": [{ "pin": "C", "block": 6, "on": { "link": 5, "through": "O5", "toward": "H" } },
          { "pin": "J", "block": 8, "on": { "link": 1, "through": [-47.047099, 193.38518], "angle": 80.214091 } }],
        "input": { "link": 4, "omega": -7.409 }, "find": ["slip(J/1)", "aslip(J/1)", "omega(5)", "alpha(6)", "I(3,5)"] }"#;
    let cylinder = r#"{ "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [88.429637, 19.101058], "O5": [170.22762, 136.7732] },
        "placed": { "A": [18.275403, 56.765336], "E": [111.80552, 136.45423], "C": [73.035126, 136.24256],
                    "B": [129.74547, 103.24245] },
        "links": { "2": { "joins": ["O2", "A"] },
          "3": { "joins": ["A", "B", "C"], "shape": { "A": [37.0834, -36.782313], "B": [113.35653, 56.85586],
                                                      "C": [47.783206, 59.138334] } },
          "4": { "joins": ["O4", "B"] }, "5": { "joins": ["C", "E"], "length": 38.770971 }, "6": { "joins": ["O5"] } },
        "slides": [{ "link": 5, "turned": -180, "on": { "link": 6, "through": "O5" } }],
        "input": { "link": 2, "omega": -4.722 }, "find": ["v(E)", "omega(5)", "alpha(5)", "slip(C/6)", "I(1,6)"] }"#;
    for scene in [davis, oldham, slotted, cylinder] {
        confirmed(scene, 1e-3);
    }
}

/// A point that is read with room, at the end of a link of given length that lies almost along x: what the room leaves open of
/// x is some 25 times that of y. Refused by the other solver before.
#[test]
fn a_room_that_a_long_lever_magnifies() {
    let scene = r#"{ "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "O4": [101.17813916423212, 15.322743105126044], "O6": [206.66655404920107, 27.57120091756286] },
        "placed": { "A": [-3.937164008329294, 48.85865290189789], "B": [100.28629278979811, 93.60028815609672],
                    "H": [178.12982893964215, 157.00442713234332], "E": { "at": [194.6, 115.5], "within": "0.071 mm" } },
        "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4", "B"] }, "5": { "joins": ["C", "E"], "length": 156.00521884225682 },
          "3": { "joins": ["A", "B", "C"], "sides": [113.42108654113174, 63.56169792713804, 73.97776492653335] },
          "6": { "joins": ["O6", "E", "H"] } },
        "near": { "C": [38.7, 109.3] }, "input": { "link": 6, "omega": 3.674 }, "find": ["omega(2)", "omega(3)"] }"#;
    confirmed(scene, 1.0);
}

/// A place with room beside the angle of its driven link: crank of 50 mm at 60°, A read 0.04 mm beside that line within 0.05.
#[test]
fn an_angle_beside_a_place_with_room() {
    let place = polar(polar([0.0, 0.0], 50.0, 60.0), 0.04, 150.0);
    let scene = format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "placed": {{ "A": {{ "at": {place:?}, "within": "0.05 mm" }} }}, "links": {{ "2": {{ "joins": ["O2", "A"] }} }},
            "input": {{ "link": 2, "angle": 60, "omega": 4 }}, "find": ["v(A)", "x(A)"] }}"#
    );
    for (name, found) in answers(&common::read(&scene)) {
        let truth = if name == "v(A)" { polar([0.0; 2], 0.2, 150.0) } else { polar([0.0; 2], 0.05, 60.0) };
        for solver in found {
            assert!((solver[0] - truth[0]).hypot(solver[1] - truth[1]) < 1e-9, "{name}: {solver:?}");
        }
    }
}

/// A rack that a pinion drives, and that drives a crank by a rod. The places of the crank's pin and the rod's length say where
/// the rack stands, rolling does not: A (0, 30), AB = 50, so that B stands at (40, 0); the pinion of 20 mm below turns at
/// −2 rad/s and moves the rack by 40 mm/s, and the crank's pin along x as fast: ω₂ = −4/3.
#[test]
fn a_rack_whose_place_the_crank_tells() {
    for input in [r#""A": [0, 30]"#, r#""A": [0, 30], "B": [40.000001, 0]"#, r#""A": [0, 30], "E": [90, 0]"#]
    {
        let scene = format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O5": [60, -20] }},
            "placed": {{ {input}, "Q": [60, -5] }}, "near": {{ {} }},
            "links": {{ "2": {{ "joins": ["O2", "A"] }}, "3": {{ "joins": ["A", "B"], "length": 50 }},
                        "4": {{ "joins": ["B", "E"], "length": 50 }}, "5": {{ "joins": ["O5", "Q"] }} }},
            "slides": [{{ "link": 4, "on": {{ "link": 1, "through": [0, 0] }} }}],
            "rolls": [{{ "links": [4, 5], "centre": "O5", "radius": 20, "line": {{ "link": 4, "through": "B", "toward": "E" }} }}],
            "input": {{ "link": 5, "omega": -2 }}, "find": ["v(B)", "omega(2)"] }}"#,
            if input.contains("\"B\"") { r#""E": [90, 0]"# } else { r#""B": [40, 0]"# }
        );
        gives(&scene, &[("v(B)", vec![0.04, 0.0]), ("omega(2)", vec![-0.04 / 0.03])]);
    }
}

/// What drives a trial may slide on an arc: its apparent acceleration has both parts. On an arc of the frame it is the pin's
/// own acceleration, and the normal part is v²/R.
#[test]
fn an_apparent_acceleration_on_an_arc_that_drives_a_trial() {
    let scene = common::read(
        r#"{ "units": { "length": "cm", "angle": "rad" },
        "placed": { "B": [6.604322890830084, -0.055470666755207176], "E": [4.555529076395099, 2.9114206197487227] },
        "links": { "2": { "joins": ["A", "B", "C"], "line": [-1.2351032756562963, 0.7648967243437043, 1.7648967243437041] },
                   "5": { "joins": ["D", "E", "C"], "sides": [3.1622776601683795, 4.242640687119285, 2] } },
        "slides": [
          { "pin": "A", "block": 4, "on": { "link": 1, "through": [6.91635946421332, 2.7934487836031208], "angle": 1.9777578587903448 } },
          { "pin": "B", "on": { "link": 1, "through": [8.43705335829473, -1.4433924298658274],
                                "angle": -1.1638347947994485, "offset": -1.1336788729129905 } },
          { "pin": "D", "block": 3, "on": { "link": 1, "centre": [8.451663748769246, 4.590746262595876], "radius": 4 } }],
        "input": { "link": 5, "angle": 2.441405467791151, "omega": -1.78 },
        "find": ["aslip(D/1)", "a(D)", "aslipn(D/1)", "aslipt(D/1)", "v(D)"] }"#,
    );
    let found = answers(&scene);
    for solver in 0..2 {
        let of = |name: &str| found.iter().find(|(n, _)| n == name).unwrap().1[solver].clone();
        let (whole, own) = (of("aslip(D/1)"), of("a(D)"));
        let (normal, along, speed) = (of("aslipn(D/1)"), of("aslipt(D/1)"), of("v(D)"));
        for axis in 0..2 {
            assert!((whole[axis] - own[axis]).abs() < 1e-12, "{found:?}");
            assert!((normal[axis] + along[axis] - own[axis]).abs() < 1e-12, "{found:?}");
        }
        let v = speed[0].hypot(speed[1]);
        assert!((normal[0].hypot(normal[1]) - v * v / 0.04).abs() < 1e-12, "{found:?}");
    }
}

/// A is stated from B, which is placed, and which dimensions and the angle of a driven link bind as well: B stands where these
/// put it. O4B = 30 at 90°, A to the left of it, 34 from O2: 16² + 30² = 34².
#[test]
fn a_place_stated_from_a_placed_point_that_dimensions_bind() {
    let scene = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [80, 0] }, "placed": { "B": [80, 30] },
        "where": { "A": [{ "from": "B", "direction": 180 }, { "from": "O2", "distance": 34 }] }, "near": { "A": [16, 30] },
        "links": { "2": { "joins": ["O2", "A"], "length": 34 }, "3": { "joins": ["A", "B"], "length": 64 },
                   "4": { "joins": ["O4", "B"], "length": 30 } },
        "input": { "link": 4, "angle": 90, "omega": 5 }, "find": ["v(B)", "x(A)"] }"#;
    gives(scene, &[("v(B)", vec![-0.15, 0.0]), ("x(A)", vec![0.016, 0.03])]);
}

/// A four-bar whose coupler has a slot, driven along it by a pin whose place (55, 55) is given: the coupler stands where its slot
/// passes there. The truth: the crank's angle at which (D − A)·(B − A) = 50 · 110, found here by halving.
#[test]
fn a_driven_pin_whose_place_is_given_on_a_guide_that_moves() {
    let places = |angle: f64| {
        let a = polar([0.0, 0.0], 40.0, angle);
        // B from A and O4 = (110, 0), above.
        let (dx, dy) = (110.0 - a[0], -a[1]);
        let far = dx.hypot(dy);
        let along = (far * far + 110.0 * 110.0 - 90.0 * 90.0) / (2.0 * far);
        let up = (110.0 * 110.0 - along * along).sqrt();
        let (cos, sin) = (dx / far, dy / far);
        (a, [a[0] + along * cos - up * sin, a[1] + along * sin + up * cos])
    };
    let beside = |angle: f64| {
        let (a, b) = places(angle);
        (55.0 - a[0]) * (b[0] - a[0]) + (55.0 - a[1]) * (b[1] - a[1]) - 50.0 * 110.0
    };
    let (mut low, mut high) = (70.0, 90.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if beside(middle) * beside(low) > 0.0 { low = middle } else { high = middle }
    }
    let (a, b) = places(low);
    let metres = |p: [f64; 2]| vec![p[0] / 1000.0, p[1] / 1000.0];
    gives(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [110, 0], "O6": [40, -30] }, "placed": { "D": [55, 55] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 110 },
                   "4": { "joins": ["O4", "B"], "length": 90 }, "5": { "joins": ["O6", "D"] } },
        "slides": [{ "pin": "D", "block": 6, "on": { "link": 3, "through": [50, -5], "angle": 90 } }],
        "near": { "A": [-10, 38], "B": [90, 85] }, "input": { "slide": "D", "velocity": 50 }, "find": ["x(A)", "x(B)"] }"#,
        &[("x(A)", metres(a)), ("x(B)", metres(b))],
    );
}

/// A driven slide whose pin is fixed says nothing of where its guide stands: that is what is told, at once.
#[test]
fn a_driven_slide_of_a_fixed_pin_needs_its_distance() {
    let scene = linkgram::scene::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [120, 30] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "E"], "length": 130 } },
        "slides": [{ "pin": "O4", "block": 4, "on": { "link": 3, "through": "A", "toward": "E" } }],
        "near": { "A": [20, 35] }, "input": { "slide": "O4", "velocity": 50 }, "find": ["v(A)"] }"#,
        "scene.json",
    );
    let error = scene.err().map(|error| error.to_string()).unwrap_or_default();
    assert!(error.contains("`at` is missing: O4 is fixed, and nothing says where link 3 stands"), "{error}");
}

/// A placed bar rides as placed on the guide of a swivel at D, which a placed lever carries: the swivel turns towards the bar's
/// first joint. Both links turn as they are driven; v(D) of the lever CD by the bar through B, which moves with O2B.
#[test]
fn a_swivel_whose_rider_rides_as_placed() {
    // O2B = 50 at 90°, ω₂ = 4: v(B) = (−200, 0). The bar BE lies along x through D = (60, 50) and turns at 3 rad/s, so that the
    // point of it under D moves with (−200, 180); D moves along y about C = (100, 50): (0, 180) by a slip of 200.
    gives(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "C": [100, 50] },
        "placed": { "B": [0, 50], "E": [90, 50], "D": [60, 50] },
        "links": { "2": { "joins": ["O2", "B"] }, "3": { "joins": ["C", "D"], "length": 40 }, "4": { "joins": ["B", "E"] },
                   "5": { "joins": ["D"] } },
        "slides": [{ "link": 4, "on": { "link": 5, "through": "D" } }],
        "inputs": [{ "link": 2, "omega": 4 }, { "link": 4, "omega": 3 }], "find": ["v(D)", "omega(3)"] }"#,
        &[("v(D)", vec![0.0, 0.18]), ("omega(3)", vec![-4.5])],
    );
}

/// A four-bar all but at its dead centre, with the rocker's pin read within a room in which it lies: that is the room's fault,
/// and the refusal says so.
#[test]
fn a_room_that_leaves_it_open_is_told() {
    // O2A = 40 along x, AB = 60 turned up by a ten-thousandth, so that O2, A and B are in line within the room of B.
    let scene = common::read(
        r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 80] },
        "placed": { "A": [40, 0], "B": { "at": [100, 0.01], "within": "0.05 mm" } },
        "links": { "2": { "joins": ["O2", "A"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] } },
        "input": { "link": 4, "omega": 2 }, "find": ["omega(2)", "v(B)"] }"#,
    );
    let solved = solve(&scene, Extent::Asked, sheet::scale::for_scene).unwrap();
    let told = format!("{:?}", solved.solution.construction.answers[0].answer);
    assert!(told.contains("Room") && told.contains("\"B\""), "{told}");
}
