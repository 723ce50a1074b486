//! Blocks on arcs under load, links of one joint with own coordinates, friction in governors, sought stiffnesses: against
//! mechanisms that are the same by law, and against numbers of another calculation.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::collections::BTreeMap;

use linkgram::check;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::solve::{solve, solve_analytically};
use serde_json::{Value, json};

use crate::common;

/// Answers of the board by name, after both solvers were found to agree.
fn answers(value: &Value) -> BTreeMap<String, Answer> {
    let scene = common::read(&value.to_string());
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let agreement = check::agreement(&scene, &solved, &solve_analytically(&scene));
    assert!(agreement.ok(), "{value}: off by {} of the bounds", agreement.worst_ratio());
    let names = scene.mechanism.asked.iter().map(|asked| asked.name.clone());
    names.zip(solved.solution.construction.answers.into_iter().map(|reading| reading.answer)).collect()
}

fn parts(answer: &Answer) -> [f64; 2] {
    match answer {
        Answer::Scalar { value, .. } => [*value, 0.0],
        Answer::Vector { value, .. } => *value,
        other => panic!("no number: {other:?}"),
    }
}

fn close(a: [f64; 2], b: [f64; 2], within: f64, what: &str) {
    let size = libm::hypot(b[0], b[1]).max(1e-9);
    let apart = libm::hypot(a[0] - b[0], a[1] - b[1]);
    assert!(apart <= within * size, "{what}: {a:?} and {b:?} differ by {apart}");
}

/// A crank, a rod, and a block on an arc about C; or a link from C to the rod in its place, of which G stands as far from C
/// as the arc's radius more.
fn curved(as_link: bool, more: &Value) -> Value {
    let own = |x: f64, y: f64| if as_link { json!([x + 180.0, y]) } else { json!([x, y]) };
    let mut scene = json!({
        "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "C": [200, -150] },
        "links": { "2": { "joins": ["O2", "A"], "length": 50 }, "3": { "joins": ["A", "B"], "length": 160 } },
        "near": { "B": [190, 30] },
        "input": { "link": 2, "angle": 60, "omega": "40 rad/s" },
        "gravity": {},
        "masses": { "3": { "mass": 2, "at": [60, 0], "inertia": 0.01 },
                    "4": { "mass": 3, "at": own(5.0, 20.0), "inertia": 0.02 } },
        "loads": [ { "on": 4, "at": own(0.0, 0.0), "force": "500 N", "direction": 180 },
                   { "on": 4, "at": own(-10.0, 15.0), "force": [40, 90], "in": 4 },
                   { "on": 4, "torque": "3 N*m" } ],
        "find": ["T(2)", "F(1,2)", "F(2,3)", "F(3,4)", "F(1,4)", "moment(F(1,4),O2)", "FS", "T(2).static", "omega(4)"]
    });
    if as_link {
        scene["links"]["4"] = json!({ "joins": ["C", "B"], "length": 180 });
    } else {
        scene["slides"] =
            json!([ { "pin": "B", "block": 4, "on": { "link": 1, "centre": "C", "radius": 180 } } ]);
    }
    for (key, value) in more.as_object().unwrap() {
        scene[key] = value.clone();
    }
    scene
}

/// A smooth arc holds its block by a force through its centre, as a pin there would: couples, inertia and loads beside the
/// pin change nothing of that.
#[test]
fn a_block_on_an_arc_is_held_as_a_link_about_its_centre() {
    let by_arc = answers(&curved(false, &json!({})));
    let by_link = answers(&curved(true, &json!({})));
    for (name, answer) in &by_link {
        close(parts(&by_arc[name]), parts(answer), 1e-9, name);
    }
    // And something turns it.
    let plain = answers(&curved(false, &json!({ "loads": [], "masses": { "4": { "mass": 3 } } })));
    assert!((parts(&plain["T(2)"])[0] - parts(&by_arc["T(2)"])[0]).abs() > 0.1);
}

/// Friction at the pins of such a block.
#[test]
fn a_pin_rubs_on_a_block_on_an_arc() {
    let find = json!(["T(2)", "F(1,2)", "F(2,3)", "F(3,4)", "F(1,4)"]);
    let more = json!({ "pins": { "A": { "circle": 2 }, "B": { "circle": 3 }, "O2": { "radius": 10, "f": 0.1 } }, "find": find });
    let by_arc = answers(&curved(false, &more));
    let by_link = answers(&curved(true, &more));
    for (name, answer) in &by_link {
        close(parts(&by_arc[name]), parts(answer), 1e-7, name);
    }
    let smooth = answers(&curved(false, &json!({ "find": ["T(2)"] })));
    assert!((parts(&smooth["T(2)"])[0] - parts(&by_arc["T(2)"])[0]).abs() > 0.1);
}

/// A link of one joint through a swivelling block: its x-axis points toward the block. By Newton's and Euler's equations
/// with motions differentiated numerically.
#[test]
fn a_link_of_one_joint_has_own_coordinates_toward_its_rider() {
    let scene = json!({
        "units": { "length": "mm" },
        "fixed": { "O2": [0, 0], "Q": [200, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A"] } },
        "slides": [ { "pin": "Q", "block": 4, "on": { "link": 3, "through": "A" } } ],
        "input": { "link": 2, "angle": 70, "omega": "10 rad/s" },
        "masses": { "3": { "mass": 4, "at": [150, 0], "inertia": 0.05 } },
        "loads": [ { "on": 3, "at": [250, 10], "force": "100 N", "direction": -90 } ],
        "find": ["T(2)", "F(4,3)", "a(G3)", "omega(3)", "alpha(3)"]
    });
    let found = answers(&scene);
    close(parts(&found["T(2)"]), [1.747_341_458_383_577, 0.0], 1e-9, "T(2)");
    close(parts(&found["a(G3)"]), [-0.581_869_437_077, -0.947_760_784_215], 1e-8, "a(G3)");
    let [x, y] = parts(&found["F(4,3)"]);
    close([libm::hypot(x, y), 0.0], [133.643_496_979_5, 0.0], 1e-9, "F(4,3)");
    // The same link with its point named: two assemblies, of which `near` chooses one.
    let mut named = scene;
    named["links"]["3"] = json!({ "joins": ["A", "G"], "shape": { "A": [0, 0], "G": [150, 0] } });
    named["near"] = json!({ "G": [160, 30] });
    named["masses"]["3"]["at"] = json!("G");
    named["find"] = json!(["T(2)", "F(4,3)"]);
    let other = answers(&named);
    for name in ["T(2)", "F(4,3)"] {
        close(parts(&found[name]), parts(&other[name]), 1e-9, name);
    }
}

fn porter(circle: f64, drag: f64) -> Value {
    let mut scene = json!({
        "fixed": { "O": [0, 0] }, "placed": { "B": [3, -4], "S": [0, -8] },
        "links": { "2": { "joins": ["O", "B"] }, "3": { "joins": ["B", "S"] } },
        "slides": [ { "pin": "S", "block": 4, "on": { "link": 1, "through": "O", "angle": 90 } } ],
        "pins": { "O": { "circle": circle }, "B": { "circle": circle }, "S": { "circle": circle } },
        "input": { "link": 2 }, "gravity": {},
        "masses": { "2": { "mass": 5, "at": "B" }, "4": { "mass": 30 } },
        "spin": { "axis": { "through": [0, 0], "angle": 90 }, "omega": "?", "balls": 2, "sleeve": 4 },
        "find": ["spin(rising)", "spin(falling)"]
    });
    if drag > 0.0 {
        scene["slides"][0]["drag"] = drag.into();
    }
    scene
}

/// A Porter governor whose pins rub, at rest in its plane: the sleeve is about to rise, or to fall. By equilibrium of the
/// bodies with friction couples r F against the turning, iterated.
#[test]
fn the_pins_of_a_governor_rub() {
    for (circle, drag, rising, falling) in [
        (0.05, 0.0, 4.223_928_130, 4.063_570_212),
        (0.1, 0.0, 4.305_399_864, 3.984_389_277),
        (0.05, 50.0, 4.521_873_861, 3.757_026_785),
        (0.1, 50.0, 4.609_926_397, 3.684_803_908),
    ] {
        let found = answers(&porter(circle, drag));
        close(parts(&found["spin(rising)"]), [rising, 0.0], 1e-8, "rising");
        close(parts(&found["spin(falling)"]), [falling, 0.0], 1e-8, "falling");
    }
}

/// What a governor at rest in its plane cannot be asked, and what rubs nowhere.
#[test]
fn what_is_refused_of_a_governor_that_rubs() {
    let refused =
        |scene: &Value| linkgram::scene::read(&scene.to_string(), "scene.json").unwrap_err().to_string();
    let mut moving = porter(0.1, 0.0);
    moving["find"] = json!(["spin(rising)", "v(B)"]);
    assert!(refused(&moving).contains("rests in its own plane"), "{}", refused(&moving));
    let mut rough = porter(0.1, 0.0);
    rough["slides"][0]["f"] = json!(0.1);
    assert!(refused(&rough).contains("hold their sleeve in balance"), "{}", refused(&rough));
    let scene = common::read(
        &{
            let mut resting = porter(0.1, 0.0);
            resting["find"] = json!(["spin"]);
            resting
        }
        .to_string(),
    );
    let why = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap_err().to_string();
    assert!(why.contains("spin(rising)"), "{why}");
}

/// A governor that moves: the sense of its drag is that of its motion, whatever drives it.
#[test]
fn the_drag_of_a_moving_governor_is_against_its_motion() {
    for (omega, speed) in [(1e-9, 4.434_805_520), (-1e-9, 3.829_817_228)] {
        let mut scene = porter(0.0, 50.0);
        scene.as_object_mut().unwrap().remove("pins");
        // The arm's angle grows as its sleeve rises.
        scene["input"]["omega"] = omega.into();
        scene["find"] = json!(["spin"]);
        close(parts(&answers(&scene)["spin"]), [speed, 0.0], 1e-6, "spin");
    }
}

/// A stiffness that is sought is printed, also where no spring has it.
#[test]
fn a_stiffness_is_told() {
    let scene = |free: f64| {
        json!({
            "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 2 } },
            "input": { "link": 2, "angle": 0 },
            "loads": [ { "on": 2, "at": "A", "force": "30 N", "direction": -90 } ],
            "springs": [ { "name": "S", "between": [ { "link": 2, "at": "A" }, { "link": 1, "at": [2, 3] } ],
                           "stiffness": "?", "free": free } ],
            "find": ["spring(S)"]
        })
    };
    // The spring stands upright and carries the load: 30 N over 3 m less its free length.
    for (free, stiffness) in [(1.0, 15.0), (5.0, -15.0)] {
        let scene = common::read(&scene(free).to_string());
        let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
        let [told] = solved.solution.construction.forces.unwrap().stiffnesses[..] else { panic!() };
        close([told.value, 0.0], [stiffness, 0.0], 1e-9, "stiffness");
    }
}

/// The figures of inertia and of links that are cut free together.
#[test]
fn figures_of_inertia_and_of_two_links() {
    let scene = common::read(&curved(true, &json!({})).to_string());
    let solved = solve(&scene, Extent::WholeSkeleton, linkgram::sheet::scale::for_scene).unwrap();
    let construction = &solved.solution.construction;
    let draw = |name: &str| {
        linkgram::sheet::single(&scene, construction, name, linkgram::sheet::Language::default())
    };
    assert!(draw("inertia").is_some());
    let polygon = draw("polygon(3,4)").unwrap();
    let options = linkgram::render::Options::default();
    let svg = linkgram::render::render(&polygon, linkgram::render::Format::Svg, &options).unwrap();
    let svg = String::from_utf8(svg).unwrap();
    // The force between the two is not among them.
    assert!(svg.contains("F(2,3)") && svg.contains("F(1,4)"), "{svg}");
    assert!(!svg.contains("F(3,4)") && !svg.contains("F(4,3)"), "{svg}");
    assert!(draw("polygon(3,9)").is_none());
}

/// The same on the arc of a lever.
#[test]
fn a_block_on_the_arc_of_a_lever_is_held_as_a_link_about_its_centre() {
    for circle in [0.0, 3.0] {
        let mut scene = json!({
            "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [0, -200] },
            "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "4": { "joins": ["O4", "D"], "length": 300 } },
            "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "centre": [100, 150], "radius": 180 } } ],
            "near": { "D": [60, 90] }, "input": { "link": 2, "angle": 60, "omega": "10 rad/s" },
            "pins": { "A": { "circle": circle } },
            "masses": { "3": { "mass": 1, "inertia": 0.004 }, "4": { "mass": 4, "at": [150, 0], "inertia": 0.05 } },
            "loads": [ { "on": 4, "at": "D", "force": "100 N", "direction": 20 }, { "on": 3, "torque": "4 N*m" } ],
            "find": ["T(2)", "F(3,4)", "F(2,3)", "F(1,4)"]
        });
        let by_arc = answers(&scene);
        let shape = json!({ "O4": [0, 0], "D": [300, 0], "C": [100, 150] });
        scene.as_object_mut().unwrap().remove("slides");
        scene["links"]["3"] = json!({ "joins": ["C", "A"], "length": 180 });
        scene["links"]["4"] = json!({ "joins": ["O4", "D", "C"], "shape": shape });
        scene["masses"]["3"]["at"] = json!("A");
        let by_link = answers(&scene);
        for (name, answer) in &by_link {
            close(parts(&by_arc[name]), parts(answer), 1e-7, name);
        }
    }
}
