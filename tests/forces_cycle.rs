//! The turning-moment diagram: printed values, closed forms, laws, and a mechanism's own torque against its energies.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use linkgram::check;
use linkgram::drawing::{Kind, Wish, figure};
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::solve::solve;

use crate::common;

fn read(text: &str) -> Scene {
    scene::read(text, "cycle.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn refusal(text: &str) -> String {
    scene::read(text, "cycle.json").unwrap_err().to_string()
}

/// Answers by name with their bounds; both solvers agree, and both know every number to 1e-9 of the largest torque's work.
fn answers(scene: &Scene) -> BTreeMap<String, f64> {
    let solved = solve(scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let analytic = linkgram::solve::solve_analytically(scene);
    let agreement = check::agreement(scene, &solved, &analytic);
    assert!(agreement.ok(), "{:?} {:?}", agreement.refused, agreement.disagreements());
    let mut told = BTreeMap::new();
    for compared in &agreement.compared {
        let (Answer::Scalar { value, bound }, Answer::Scalar { bound: other, .. }) =
            (&compared.graphical.answer, &compared.analytic)
        else {
            panic!("{}: {:?} {:?}", compared.asked.name, compared.graphical.answer, compared.analytic);
        };
        assert!(*bound > 0.0 || *value == 0.0 || *other > 0.0, "{}", compared.asked.name);
        told.insert(compared.asked.name.clone(), *value);
    }
    told
}

fn near(found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 1e-8 * wanted.abs().max(1.0), "{found} is not {wanted}");
}

fn diagram(cycle: &str, find: &str) -> Scene {
    read(&format!(
        r#"{{ "links": {{}}, "input": {{ "omega": 20 }}, "cycle": {{ {cycle} }}, "find": [{find}] }}"#
    ))
}

const ALL: &str = r#""Tmean", "E", "power", "Emax", "Emin", "Ef", "Ke""#;

#[test]
fn the_books_diagrams_hold() {
    for stem in ["forces/s000-ch5-7", "forces/s000-ch5-8", "forces/s000-ch5-9"] {
        let checked = check::check(&common::example(stem), 0.005);
        assert!(checked.ok, "{stem}: {:?}", checked.outcome);
    }
}

/// A sine over its mean: crossings at half turns, Ef = 2 a / k, whatever the mean.
#[test]
fn a_sine_is_the_closed_form() {
    let scene = diagram(
        r#""torque": { "harmonics": { "constant": 50, "sin": [[3, 20]] } }, "rotating": [ { "inertia": 2 }, { "mass": 3, "gyration": 0.5, "ratio": -2 } ]"#,
        &format!(
            r#"{ALL}, "Ks", "I", "crossing(1)", "crossing(2)", "crossing(6)", "area(1)", "area(2)", "level(2)", "angle(Emax)", "angle(Emin)", "alpha(max)", "alpha(min)", "angle(alpha_max)", "angle(alpha_min)""#
        ),
    );
    let found = answers(&scene);
    near(found["Tmean"], 50.0);
    near(found["E"], 100.0 * PI);
    near(found["power"], 1000.0);
    near(found["Ef"], 40.0 / 3.0);
    near(found["Ke"], 40.0 / 3.0 / (100.0 * PI));
    near(found["I"], 5.0);
    near(found["Ks"], 40.0 / 3.0 / (5.0 * 400.0));
    near(found["crossing(1)"], 0.0);
    near(found["crossing(2)"], PI / 3.0);
    near(found["crossing(6)"], 5.0 * PI / 3.0);
    near(found["area(1)"], 40.0 / 3.0);
    near(found["area(2)"], -40.0 / 3.0);
    near(found["level(2)"], 40.0 / 3.0);
    near(found["angle(Emax)"], PI / 3.0);
    near(found["angle(Emin)"], 0.0);
    near(found["alpha(max)"], 4.0);
    near(found["alpha(min)"], -4.0);
    assert!((found["angle(alpha_max)"] - PI / 6.0).abs() < 1e-6);
    assert!((found["angle(alpha_min)"] - PI / 2.0).abs() < 1e-6);
}

/// Steps: the torque leaps through its mean, and that is a crossing; where it only touches there is none.
#[test]
fn a_leap_counts_and_a_touch_does_not() {
    let scene = diagram(
        r#""torque": { "table": [[0, 300], [90, 300], [90, 0], [360, 0]] }"#,
        &format!(r#"{ALL}, "crossing(1)", "crossing(2)", "area(1)", "level(1)", "angle(Emax)""#),
    );
    let found = answers(&scene);
    near(found["Tmean"], 75.0);
    near(found["crossing(1)"], 0.0);
    near(found["crossing(2)"], PI / 2.0);
    near(found["level(1)"], 0.0);
    near(found["area(1)"], 225.0 * PI / 2.0);
    near(found["Ef"], 225.0 * PI / 2.0);
    near(found["angle(Emax)"], PI / 2.0);
    // Up from the mean at 90°, and back to it at 180°; it touches it at 270°.
    let touching =
        r#""torque": { "table": [[0, 10], [90, 20], [180, 10], [225, 0], [270, 10], [315, 0], [360, 10]] }"#;
    let scene = diagram(touching, r#""Tmean", "crossing(1)", "crossing(2)", "Ef""#);
    let found = answers(&scene);
    near(found["Tmean"], 10.0);
    near(found["crossing(1)"], 0.0);
    near(found["crossing(2)"], PI);
    near(found["Ef"], 10.0 * PI / 2.0);
    let scene = diagram(touching, r#""Tmean", "crossing(3)""#);
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let why = format!("{:?}", solved.answer(&scene, "crossing(3)").unwrap());
    assert!(why.contains("there are 2 crossings"), "{why}");
}

/// Copies add up: three sines a third of a turn apart cancel, and a table shifted by its period is itself twice.
#[test]
fn copies_add_up() {
    let one = r#""torque": { "harmonics": { "constant": 30, "sin": [[1, 12]], "cos": [[3, 5]] } }"#;
    let found = answers(&diagram(&format!(r#"{one}, "copies": {{ "number": 3, "shift": 120 }}"#), ALL));
    near(found["Tmean"], 90.0);
    // Only the third harmonic is left, three times: 2 a/k.
    near(found["Ef"], 2.0 * 15.0 / 3.0);
    let table =
        r#""torque": { "table": [[0, 0], [30, 90], [200, 20], [200, -40], [300, 60]] }, "period": 360"#;
    let (single, double) = (
        answers(&diagram(table, ALL)),
        answers(&diagram(&format!(r#"{table}, "copies": {{ "number": 2, "shift": 360 }}"#), ALL)),
    );
    for name in ["Tmean", "E", "Emax", "Emin", "Ef"] {
        near(double[name], 2.0 * single[name]);
    }
    near(double["Ke"], single["Ke"]);
}

/// A period of two turns; half orders; a load that varies as well is what the torque is above or below.
/// A constant torque that drives clockwise from 30° to 120° of turning, and nothing else: the diagram runs down from
/// angle 0, so it begins with the mean taken off for 30°.
#[test]
fn a_clockwise_crank_runs_its_diagram_backwards() {
    let scene = read(
        r#"{ "fixed": { "O2": [0, 0] }, "links": { "2": { "joins": ["O2", "A"], "length": 1 } },
             "input": { "link": 2, "angle": 0, "omega": "10 rad/s cw" },
             "loads": [ { "on": 2, "torque": { "table": [[0, 0], [240, 0], [240, -100], [330, -100], [330, 0]] } } ],
             "cycle": { "torque": { "of": 2 }, "rotating": [ { "inertia": 2 } ] },
             "find": ["Tmean", "Emax", "Emin", "Ef", "angle(Emax)", "angle(Emin)", "crossing(1)", "crossing(2)",
                      "level(1)", "level(2)", "area(1)", "area(2)", "alpha(max)", "angle(alpha_max)", "alpha(min)"] }"#,
    );
    let found = answers(&scene);
    let degrees = PI / 180.0;
    let mean = 100.0 * 90.0 / 360.0;
    near(found["Tmean"], mean);
    near(found["crossing(1)"], 330.0 * degrees);
    near(found["level(1)"], -mean * 30.0 * degrees);
    near(found["area(1)"], (100.0 - mean) * 90.0 * degrees);
    near(found["crossing(2)"], 240.0 * degrees);
    near(found["level(2)"], (-mean * 30.0 + (100.0 - mean) * 90.0) * degrees);
    near(found["area(2)"], -(100.0 - mean) * 90.0 * degrees);
    near(found["Emax"], found["level(2)"]);
    near(found["Emin"], found["level(1)"]);
    near(found["angle(Emax)"], 240.0 * degrees);
    near(found["angle(Emin)"], 330.0 * degrees);
    near(found["alpha(max)"], (100.0 - mean) / 2.0);
    near(found["alpha(min)"], -mean / 2.0);
    near(found["angle(alpha_max)"], 330.0 * degrees);
}

/// A mechanism and its mirror image have one diagram, but for the angles, which are less of a turn; with copies that
/// follow unevenly, and harmonics on the other side, too.
#[test]
fn a_mirrored_mechanism_has_the_mirrored_diagram() {
    let asked = r#""Tmean", "E", "power", "Emax", "Emin", "Ef", "Ke", "Ks", "crossing(1)", "level(1)", "area(1)",
        "crossing(2)", "level(2)", "area(2)", "angle(Emax)", "angle(Emin)", "alpha(max)", "alpha(min)",
        "angle(alpha_max)", "angle(alpha_min)""#;
    let found = [("ccw", -20, "[[0, 2000], [90, 0], [180, 0], [270, 500]]"), ("cw", 20, "[[0, 2000], [90, 500], [180, 0], [270, 0]]")]
        .map(|(sense, guide, table)| {
            let scene = read(&format!(
                r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
                  "links": {{ "2": {{ "joins": ["O2", "A"], "length": 50 }}, "3": {{ "joins": ["A", "B"], "length": 150 }} }},
                  "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": [0, {guide}] }} }} ],
                  "near": {{ "B": [190, {guide}] }}, "input": {{ "link": 2, "angle": 0, "omega": "60 rad/s {sense}" }},
                  "masses": {{ "4": {{ "mass": 1.5 }} }},
                  "loads": [ {{ "name": "P", "on": 4, "force": {{ "table": {table} }}, "direction": 180 }} ],
                  "cycle": {{ "torque": {{ "of": 2 }}, "copies": {{ "number": 2, "shift": 75 }}, "rotating": [ {{ "inertia": 2 }} ] }},
                  "find": [{asked}] }}"#
            ));
            answers(&scene)
        });
    let [ccw, cw] = found;
    for (name, value) in &ccw {
        let angle = name.starts_with("angle") || name.starts_with("crossing");
        near(if angle { TAU - cw[name] } else { cw[name] }, *value);
    }
}

/// Levels are sums of the areas, whatever the mean is: 52 − 124 + … in squares of 500 N m by 6°.
#[test]
fn areas_need_their_total_for_the_mean_alone() {
    let areas = r#""torque": { "areas": [52, -124, 92, -140, 85, -72, 107], "scale": { "torque": "500 N*m", "angle": "6 deg" } },
        "fluctuation": 0.02"#;
    let found = answers(&diagram(areas, r#""Ef", "If", "level(2)", "area(3)", "Emax""#));
    let square = 500.0 * 6.0 * PI / 180.0;
    near(found["level(2)"], (52.0 - 124.0) * square);
    near(found["area(3)"], 92.0 * square);
    near(found["Emax"], 52.0 * square);
    near(found["Ef"], (52.0 + 120.0) * square);
    near(found["If"], (52.0 + 120.0) * square / (0.02 * 400.0));
    for name in ["Tmean", "E", "power", "Ke"] {
        let text = format!(
            r#"{{ "links": {{}}, "input": {{ "omega": 20 }}, "cycle": {{ {areas} }}, "find": ["{name}"] }}"#
        );
        assert!(refusal(&text).contains("`total`"), "{}", refusal(&text));
    }
    // Without `find` nothing is asked that has no answer.
    let text = format!(r#"{{ "links": {{}}, "input": {{ "omega": 20 }}, "cycle": {{ {areas} }} }}"#);
    assert!(answers(&read(&text)).contains_key("Ef"));
}

#[test]
fn two_turns_and_a_varying_load() {
    let found = answers(&diagram(
        r#""torque": { "harmonics": { "constant": 40, "sin": [[0.5, 8]] } }, "period": 720"#,
        r#""E", "Ef", "crossing(2)""#,
    ));
    near(found["E"], 160.0 * PI);
    near(found["Ef"], 2.0 * 8.0 / 0.5);
    near(found["crossing(2)"], TAU);
    // The same on both sides but for a wave: only the wave is left.
    let found = answers(&diagram(
        r#""torque": { "harmonics": { "constant": 40, "sin": [[2, 9]], "cos": [[1, 6]] } },
           "load": { "harmonics": { "constant": 40, "cos": [[1, 6]] } }"#,
        r#""Tmean", "Ef""#,
    ));
    near(found["Tmean"], 40.0);
    near(found["Ef"], 9.0);
    // A constant torque against a table is the mirror of the table as torque.
    let table = r#"{ "table": [[0, 10], [60, 80], [90, 20], [210, 50], [360, 10]] }"#;
    let torque = answers(&diagram(&format!(r#""torque": {table}"#), ALL));
    let load = answers(&diagram(&format!(r#""load": {table}"#), ALL));
    near(load["Emax"], -torque["Emin"]);
    near(load["Emin"], -torque["Emax"]);
    near(load["Tmean"], torque["Tmean"]);
}

/// A table of straight pieces against many short pieces added up here, and a table with a wave on the other side.
#[test]
fn a_table_against_a_plain_sum() {
    let knots = [(0.0, 10.0), (50.0, 120.0), (140.0, -30.0), (140.0, 40.0), (250.0, 70.0), (360.0, 10.0)];
    let at = |degrees: f64| {
        let next = knots.iter().position(|(angle, _)| *angle > degrees).unwrap_or(knots.len() - 1);
        let ((a, from), (b, to)) = (knots[next - 1], knots[next]);
        from + (to - from) * (degrees - a) / (b - a)
    };
    let area: f64 = knots.windows(2).map(|w| (w[1].0 - w[0].0) * (w[1].1 + w[0].1) / 2.0).sum();
    let mean = area / 360.0;
    let wave = |degrees: f64| mean + 25.0 * libm::cos(2.0 * degrees.to_radians());
    let (mut level, mut most, mut least) = (0.0_f64, 0.0_f64, 0.0_f64);
    let many = 360_000;
    for k in 0..many {
        let degrees = (f64::from(k) + 0.5) * 360.0 / f64::from(many);
        level += (at(degrees) - wave(degrees)) * TAU / f64::from(many);
        most = most.max(level);
        least = least.min(level);
    }
    let told: Vec<String> = knots.iter().map(|(angle, size)| format!("[{angle}, {size}]")).collect();
    let found = answers(&diagram(
        &format!(
            r#""torque": {{ "table": [{}] }}, "load": {{ "harmonics": {{ "constant": {mean}, "cos": [[2, 25]] }} }}"#,
            told.join(", ")
        ),
        r#""Emax", "Emin", "Ef", "Tmean""#,
    ));
    near(found["Tmean"], mean);
    assert!(
        (found["Emax"] - most).abs() < 1e-4 && (found["Emin"] - least).abs() < 1e-4,
        "{found:?} {most} {least}"
    );
}

#[test]
fn a_flywheel_is_what_is_still_needed() {
    let cycle = r#""torque": { "harmonics": { "constant": 50, "sin": [[1, 20]] } }, "fluctuation": 0.02"#;
    let found = answers(&diagram(
        &format!(r#"{cycle}, "rotating": [ {{ "weight": 98.1, "gyration": "20 cm" }} ]"#),
        r#""If", "I", "Ks", "alpha(max)""#,
    ));
    let needed = 40.0 / (0.02 * 400.0);
    near(found["I"], 0.4);
    near(found["If"], needed - 0.4);
    near(found["Ks"], 0.02);
    near(found["alpha(max)"], 20.0 / needed);
    // What turns is heavy enough.
    let scene = diagram(&format!(r#"{cycle}, "rotating": [ {{ "inertia": 9 }} ]"#), r#""If", "I""#);
    let solved = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    assert!(format!("{:?}", solved.answer(&scene, "If")).contains("no flywheel is needed"));
}

/// What has no diagram is refused with the reason.
#[test]
fn what_has_no_diagram_is_refused() {
    let unsolved = |cycle: &str, find: &str| {
        solve(&diagram(cycle, find), Extent::Asked, linkgram::sheet::scale::for_scene)
            .unwrap_err()
            .to_string()
    };
    let told = unsolved(r#""torque": { "harmonics": { "sin": [[1, 20]] } }"#, r#""Ef""#);
    assert!(told.contains("mean torque is zero"), "{told}");
    let told = unsolved(
        r#""torque": { "harmonics": { "constant": 20 } }, "load": { "harmonics": { "constant": 21 } }"#,
        r#""Ef""#,
    );
    assert!(told.contains("different means"), "{told}");
    let told = unsolved(
        r#""torque": { "areas": [3, -2], "scale": { "torque": 1, "angle": 1 }, "total": 5 }"#,
        r#""Ef""#,
    );
    assert!(told.contains("differ by"), "{told}");
    let areas =
        r#""torque": { "areas": [3, -3], "scale": { "torque": "2 N*m", "angle": "90 deg" }, "total": 5 }"#;
    let told = unsolved(areas, r#""crossing(1)""#);
    assert!(told.contains("do not say at which angle"), "{told}");
    near(answers(&diagram(areas, r#""Ef", "level(1)", "area(2)""#))["Ef"], 3.0 * PI);
    let told = unsolved(
        r#""torque": { "harmonics": { "constant": 50, "sin": [[1, 40]] } }, "rotating": [ { "inertia": 0.01 } ]"#,
        r#""Ks""#,
    );
    assert!(told.contains("too light"), "{told}");
    let bad = |more: &str, find: &str| {
        refusal(&format!(r#"{{ "links": {{}}, "input": {{ "omega": 2 }}, {more} "find": ["{find}"] }}"#))
    };
    let table = r#""cycle": { "torque": { "table": [[0, 1], [90, 2]] } },"#;
    for (more, find, what) in [
        ("", "Ef", "nothing moves"),
        (r#""cycle": {},"#, "Ef", "`torque` or `load` is missing"),
        (table, "If", "no fluctuation of speed is wanted"),
        (table, "I", "nothing is said of what turns"),
        (table, "crossing(0)", "from 1"),
        (table, "v(A)", "no point `A`"),
        (r#""cycle": { "torque": { "of": 2 } },"#, "Ef", "link 2"),
        (r#""cycle": { "torque": { "table": [[90, 1], [0, 2]] } },"#, "Ef", "ascend"),
        (r#""cycle": { "torque": { "table": [[0, 1], [400, 2]] } },"#, "Ef", "longer than its period"),
        (
            r#""cycle": { "torque": { "harmonics": { "constant": 1, "sin": [[0.5, 1]] } } },"#,
            "Ef",
            "whole number of waves",
        ),
        (r#""cycle": { "torque": { "table": [[0, 1]] }, "fluctuation": 2 },"#, "Ef", "between 0 and 2"),
        (r#""cycle": { "torque": { "table": [[0, "3 kg"]] } },"#, "Ef", "torque"),
    ] {
        let told = bad(more, find);
        assert!(told.contains(what), "{told}");
    }
}

const CRANK: &str = r#"{
  "units": { "length": "mm" }, "fixed": { "O2": [0, 0] },
  "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 } },
  "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ],
  "near": { "B": [240, 0] }, "input": { "link": 2, "angle": 50, "omega": "10 rad/s ccw", "alpha": 3 },
  "gravity": {}, "masses": { "2": { "mass": 2, "at": "A" }, "3": { "mass": 1.5, "inertia": 0.01, "at": "B" }, "4": { "mass": 0.8 } }"#;

/// A pump: a load against its piston takes 4 F r in a turn; weights and inertia take nothing over a turn, but move
/// the levels. The levels are those of the energies.
#[test]
fn a_mechanisms_own_torque_against_its_energies() {
    let scene = read(&format!(
        r#"{CRANK}, "loads": [ {{ "on": 4, "force": 1500, "direction": "against" }} ],
        "cycle": {{ "load": {{ "of": 2 }}, "fluctuation": 0.04 }}, "find": ["E", "Tmean", "Ef", "Emax", "crossing(1)", "level(2)", "If", "alpha(max)"] }}"#
    ));
    let found = answers(&scene);
    near(found["E"], 4.0 * 1500.0 * 0.06);
    near(found["Tmean"], 360.0 / TAU);
    near(found["If"], found["Ef"] / (0.04 * 100.0));
    // A spring and a force of the world do no work in a turn: the mean is that of the torque, and the sum of both
    // cycles is the cycle of the sum.
    let torque = |loads: &str| {
        answers(&read(&format!(
            r#"{CRANK}, "springs": [ {{ "between": [ {{ "link": 4, "at": "B" }}, {{ "link": 1, "at": [100, 50] }} ], "stiffness": "2 kN/m", "free": 60 }} ],
            "loads": [ {{ "on": 4, "force": [300, -20] }}, {{ "on": 2, "torque": {loads} }} ],
            "cycle": {{ "torque": {{ "of": 2 }} }}, "find": ["E", "Ef"] }}"#
        )))
    };
    let (one, two) = (torque("12"), torque("24"));
    near(one["E"], 12.0 * TAU);
    near(two["E"], 24.0 * TAU);
    near(one["Ef"], two["Ef"]);
}

/// Every figure of a diagram is drawn, in every language, and confirmed.
#[test]
fn diagrams_are_drawn() {
    for stem in ["forces/s000-ch5-7", "forces/s000-ch5-8", "forces/s000-ch5-9"] {
        let mut scene = common::example(stem);
        for language in ["en", "ar", "fa"] {
            scene.sheet.language = Some(language.to_owned());
            let drawn = linkgram::drawing::figure(&scene, &linkgram::drawing::Wish::default());
            let figure = drawn.unwrap_or_else(|error| panic!("{stem}: {}", error.told(&scene)));
            let mut classes = std::collections::BTreeSet::new();
            let mut waiting = vec![&figure.root];
            while let Some(group) = waiting.pop() {
                classes.insert(group.class.to_string());
                waiting.extend(group.children.iter().filter_map(|node| match node {
                    linkgram::sheet::figure::Node::Group(group) => Some(group),
                    _ => None,
                }));
            }
            assert!(classes.iter().any(|class| class == "energy"), "{classes:?}");
            assert_eq!(classes.iter().any(|class| class == "turning-moment"), stem != "forces/s000-ch5-8");
        }
    }
}

/// A question shows the given curve and nothing of the answer; a solution computes each number from those before it.
#[test]
fn a_diagram_is_asked_for_and_computed() {
    let text = std::fs::read_to_string(common::root().join("src/catalogue/turning-moment.json")).unwrap();
    let scene = read(&text);
    let told = |kind: Kind| {
        let figure = figure(&scene, &Wish { kind, ..Wish::default() });
        let figure = figure.unwrap_or_else(|error| panic!("{}", error.told(&scene)));
        let mut lines = Vec::new();
        figure.root.walk(&mut |node| {
            if let linkgram::sheet::figure::Node::Text(text) = node {
                lines.push(text.content().replace('\u{a0}', " "));
            }
        });
        (lines.join(" "), linkgram::render::svg::write(&figure))
    };
    let (asked, ink) = told(Kind::Question);
    assert!(!asked.contains("Kinematic skeleton"), "{asked}");
    assert!(asked.contains("ω = 300 rpm") && asked.contains("the mean torque Tm"), "{asked}");
    assert!(ink.contains("curve torque"));
    for part in ["mean-line", "crossing", "hatch"] {
        assert!(!ink.contains(&format!("class=\"{part}\"")), "{part}");
    }
    let (solved, _) = told(Kind::Solution);
    for line in ["2π × 300 / 60", "Tm = E / θC", "P = Tm × ω", "Ef = Emax − Emin", "If = Ef / (Ks × ω²) − I"]
    {
        assert!(solved.contains(line), "{line}: {solved}");
    }
}

/// What drives is positive whichever way the input turns, and the power is the work of a period by its time.
#[test]
fn work_and_power_have_one_sign() {
    let table = r#""torque": { "table": [[0, 0], [60, 800], [180, 0], [360, 0]] }"#;
    for (omega, sense) in [(30.0, "ccw"), (30.0, "cw")] {
        let told = answers(&read(&format!(
            r#"{{ "links": {{}}, "input": {{ "omega": "{omega} rad/s {sense}" }}, "cycle": {{ {table} }},
                "find": ["Tmean", "E", "power"] }}"#
        )));
        near(told["E"], 400.0 * PI);
        near(told["power"], told["E"] * omega / TAU);
        // A slider of 50 mm crank against 400 N: 2 · 0.1 m · 400 N a turn.
        let told = answers(&read(&format!(
            r#"{{ "fixed": {{ "O": [0, 0] }},
                "links": {{ "2": {{ "joins": ["O", "A"], "length": 0.05 }}, "3": {{ "joins": ["A", "B"], "length": 0.2 }} }},
                "slides": [{{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O" }} }}],
                "near": {{ "B": [0.24, 0] }}, "input": {{ "link": 2, "angle": 30, "omega": "{omega} rad/s {sense}" }},
                "loads": [{{ "on": 4, "force": 400, "direction": "against" }}],
                "cycle": {{ "load": {{ "of": 2 }} }}, "find": ["E", "power"] }}"#
        )));
        assert!((told["E"] - 80.0).abs() < 1e-6, "{}", told["E"]);
        near(told["power"], told["E"] * omega / TAU);
    }
}

/// Friction takes work that no potential has: T₂ of a slider-crank with friction in its guide, over a turn, as quadrature of
/// its own closed form gives it. A drag of 50 N takes 2 · 0.1 m · 50 N besides.
#[test]
fn friction_takes_work() {
    let scene = |rubs: &str| {
        read(&format!(
            r#"{{ "fixed": {{ "O": [0, 0] }},
                "links": {{ "2": {{ "joins": ["O", "A"], "length": 0.05 }}, "3": {{ "joins": ["A", "B"], "length": 0.2 }} }},
                "slides": [{{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O" }}, {rubs} }}],
                "near": {{ "B": [0.24, 0] }}, "input": {{ "link": 2, "angle": 30, "omega": "30 rad/s ccw" }},
                "loads": [{{ "on": 4, "force": 400, "direction": "against" }}],
                "cycle": {{ "load": {{ "of": 2 }} }}, "find": ["E"] }}"#
        ))
    };
    let told = answers(&scene(r#""drag": 50"#));
    assert!((told["E"] - 90.0).abs() < 1e-6, "{}", told["E"]);
    // Along the guide Q cos β = P + f |N|, across it N = Q sin β: the rod's force is Q = P/(cos β − f |sin β|).
    let (r, l, f, load) = (0.05_f64, 0.2_f64, 0.1, 400.0);
    let torque = |theta: f64| {
        let (sin, cos) = libm::sincos(theta);
        let (across, along) = (r * sin / l, (1.0 - (r * sin / l) * (r * sin / l)).sqrt());
        let speed = (-r * sin - r * r * sin * cos / (l * along)).abs();
        let push = load / (along - f * across.abs());
        (load + f * push * across.abs()) * speed
    };
    let steps = 200_000;
    let width = TAU / f64::from(steps);
    let work: f64 = (0..steps).map(|k| torque((f64::from(k) + 0.5) * width) * width).sum();
    let told = answers(&scene(r#""f": 0.1"#));
    assert!((told["E"] - work).abs() < 1e-5, "{} is not {work}", told["E"]);
}

/// What a sheet says of a diagram: each number at the left of a sign of equality with all that stands right of it.
fn lines_of(scene: &Scene) -> Vec<String> {
    let figure = figure(scene, &Wish::default()).unwrap_or_else(|error| panic!("{}", error.told(scene)));
    let lines = crate::legibility::sentences(&figure);
    lines.into_iter().map(|line| line.replace('\u{a0}', " ").trim_start_matches("– ").to_owned()).collect()
}

/// The line that gives a number, what it comes to, and half a unit of its last place.
fn source<'a>(lines: &'a [String], of: &str) -> (&'a str, f64, f64) {
    let begins = format!("{of} =");
    let line = lines
        .iter()
        .find(|line| line.contains(&begins))
        .unwrap_or_else(|| panic!("no line of {of}: {lines:#?}"));
    let from = line.find(&begins).unwrap() + begins.len();
    let own = line[from..].split([',', ';']).next().unwrap().trim_end_matches('.');
    let (value, half, _) =
        crate::legibility::number(own.rsplit('=').next().unwrap()).unwrap_or_else(|| panic!("{line}"));
    (line, value, half)
}

/// Every number of a diagram has a line that gives it: by trapezia, by an integral, or measured, and then from the lines before.
#[test]
fn every_number_of_a_diagram_has_its_line() {
    let harmonics = r#""torque": { "harmonics": { "constant": 2500, "sin": [[2, 675]] } },
        "load": { "harmonics": { "constant": 2500, "sin": [[1, 270]] } }"#;
    let cylinders = r#""torque": { "table": [[0, 0], [60, 800], [180, 0], [360, 0]] }, "copies": { "number": 3, "shift": 120 }"#;
    let waves = r#""torque": { "harmonics": { "constant": 100, "sin": [[1, 90], [3, 60]] } }, "copies": { "number": 3, "shift": 120 }"#;
    let tables = r#""torque": { "table": [[0, 0], [90, 400], [180, 0], [360, 0]] },
        "load": { "table": [[0, 0], [180, 0], [180, 400], [360, 0]] }"#;
    let leap = r#""torque": { "table": [[0, 300], [90, 300], [90, 0], [360, 0]] }"#;
    let mixed = r#""torque": { "harmonics": { "constant": 50, "sin": [[1, 30]] } },
        "load": { "table": [[0, 50], [180, 50], [180, 60], [270, 60], [270, 40], [360, 40]] }"#;
    let turns = r#""rotating": [ { "mass": 5, "gyration": "30 cm" }, { "mass": 20, "gyration": "30 cm", "ratio": 0.5 } ]"#;
    // Closed forms: E of a period, the first area, the greatest difference of the torques.
    let steepest = libm::acos((270.0 + libm::sqrt(270.0 * 270.0 + 8.0 * 1350.0 * 1350.0)) / (4.0 * 1350.0));
    let second = libm::acos((270.0 - libm::sqrt(270.0 * 270.0 + 8.0 * 1350.0 * 1350.0)) / (4.0 * 1350.0));
    let net = |at: f64| 675.0 * libm::sin(2.0 * at) - 270.0 * libm::sin(at);
    let most = [steepest, -steepest, second, -second].map(net).into_iter().fold(0.0, f64::max);
    let equal = libm::acos(270.0 / (2.0 * 675.0));
    let integral = |at: f64| 270.0 * libm::cos(at) - 337.5 * libm::cos(2.0 * at);
    // 30 sin θ − 10 from 180° to 270°, then 30 sin θ + 10 to where it is zero.
    let third = libm::asin(1.0 / 3.0);
    let below = -30.0 - 5.0 * PI - 30.0 * libm::cos(third) + 10.0 * (PI / 2.0 - third);
    // Of three cylinders the third harmonic alone is left: 300 + 180 sin 3θ.
    for (cycle, work, first, difference) in [
        (harmonics, 2500.0 * TAU, integral(equal) - integral(0.0), most),
        (cylinders, 1200.0 * PI, 0.5 * 200.0 * PI / 3.0, 200.0),
        (waves, 300.0 * TAU, 180.0 * 2.0 / 3.0, 180.0),
        (tables, 200.0 * PI, 200.0 * PI, 400.0),
        (leap, 150.0 * PI, 225.0 * PI / 2.0, 225.0),
        (mixed, 50.0 * TAU, below, 30.0),
    ] {
        let scene = diagram(
            &format!("{cycle}, {turns}"),
            r#""E", "Ef", "Ke", "Ks", "I", "area(1)", "alpha(max)", "angle(alpha_max)""#,
        );
        let lines = lines_of(&scene);
        let near = |of: &str, value: f64| {
            let (line, told, half) = source(&lines, of);
            assert!((told - value).abs() <= half.max(1e-3 * value.abs()), "{line}: not {value}");
        };
        near("E", work);
        near("A_1", first);
        near("I", 0.9);
        near("α_max", difference / 0.9);
        source(&lines, "θ(α_max)");
        let count = lines.iter().filter(|line| line.starts_with("A_")).count();
        assert!(count >= 2, "{lines:#?}");
        for k in 1..=count {
            for of in [format!("A_{k}"), format!("E_{k}"), format!("θ_{k}")] {
                source(&lines, &of);
            }
            let (line, told, half) = source(&lines, &format!("A_{k}"));
            let arithmetic = line.split('=').rev().nth(1).unwrap();
            let reckoned = crate::legibility::reckoned(&arithmetic.replace("cm²", "").replace("mm²", ""))
                .unwrap_or_else(|| panic!("{line}"));
            assert!((reckoned - told).abs() <= half * (1.0 + 1e-6), "{line}");
        }
        // One unit for an energy, in lines, table and scale.
        let figure = figure(&scene, &Wish::default()).unwrap();
        let mut tables = String::new();
        figure.root.walk(&mut |node| {
            if let linkgram::sheet::figure::Node::Text(text) = node {
                tables += &(text.content().replace('\u{a0}', " ") + "\n");
            }
        });
        let cells = tables.lines().filter(|line| line.ends_with("N·m") && line.split(' ').count() == 2);
        assert_eq!(cells.count(), 0, "{tables}");
        assert!(tables.contains("J ≡ 1 cm"), "{tables}");
    }
}

/// A torque that runs down with the angle of a clockwise input, and one of a mechanism, have lines as well.
#[test]
fn a_mechanism_s_own_diagram_is_measured() {
    let scene = read(
        r#"{ "fixed": { "O": [0, 0] },
            "links": { "2": { "joins": ["O", "A"], "length": 0.05 }, "3": { "joins": ["A", "B"], "length": 0.2 } },
            "slides": [{ "pin": "B", "block": 4, "on": { "link": 1, "through": "O" } }],
            "near": { "B": [0.24, 0] }, "input": { "link": 2, "angle": 30, "omega": "30 rad/s cw" },
            "loads": [{ "on": 4, "force": 400, "direction": "against" }],
            "cycle": { "load": { "of": 2 }, "rotating": [ { "inertia": 2 } ] }, "find": ["E", "Ef", "Ks", "alpha(max)"] }"#,
    );
    let lines = lines_of(&scene);
    let (line, work, _) = source(&lines, "E");
    // 400 N over twice the stroke of 0.1 m.
    assert!(line.contains("cm²") && (work - 80.0).abs() < 0.2, "{line}");
    let (line, area, half) = source(&lines, "A_1");
    let arithmetic = line.split('=').rev().nth(1).unwrap().replace("cm²", "").replace("mm²", "");
    assert!(
        (crate::legibility::reckoned(&arithmetic).unwrap() - area).abs() <= half * (1.0 + 1e-6),
        "{line}"
    );
    source(&lines, "E_2");
    source(&lines, "α_max");
}

/// At both dead points of a slotted lever a load against its ram needs no torque at all: of the two equal greatest
/// accelerations the first one is told, where the crank is square to the lever.
#[test]
fn a_maximum_is_the_first_of_equal_ones() {
    let (crank, centres) = (80.0_f64, 200.0);
    for turn in ["ccw", "cw"] {
        let scene = read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0], "O4": [0, -{centres}] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": {crank} }}, "4": {{ "joins": ["O4", "C"], "length": 480 }},
                       "5": {{ "joins": ["C", "D"], "length": 160 }} }},
            "near": {{ "A": [40, 69], "C": [60, 270], "D": [-90, 250] }},
            "input": {{ "link": 2, "angle": 60, "omega": "60 rpm {turn}" }},
            "slides": [ {{ "pin": "A", "block": 3, "on": {{ "link": 4, "through": "O4" }} }},
                        {{ "pin": "D", "block": 6, "on": {{ "link": 1, "through": [0, 260] }} }} ],
            "loads": [ {{ "name": "P", "on": 6, "force": "3 kN", "direction": "against" }} ],
            "cycle": {{ "load": {{ "of": 2 }}, "rotating": [ {{ "inertia": 20 }} ] }},
            "find": ["Tmean", "alpha(max)", "angle(alpha_max)"] }}"#
        ));
        let told = answers(&scene);
        // From the line of centres, at which the lever stands at the end of its swing.
        let aside = libm::acos(crank / centres);
        let dead = [1.5 * PI - aside, 1.5 * PI + aside];
        let first = if turn == "ccw" { dead[0] } else { dead[1] };
        assert!((told["angle(alpha_max)"] - first).abs() < 1e-6, "{turn}: {told:?}");
        near(told["alpha(max)"], told["Tmean"].abs() / 20.0);
    }
}

/// What several copies of both curves come to is said with them.
#[test]
fn copies_are_of_both_curves() {
    let scene = diagram(
        r#""torque": { "harmonics": { "constant": 30, "sin": [[1, 50]] } }, "load": { "table": [[0, 60]] },
           "copies": { "number": 2, "shift": 180 }, "rotating": [ { "inertia": 1 } ]"#,
        r#""Ef""#,
    );
    let why = solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap_err().to_string();
    assert!(why.contains("60.000000 N m and 120.000000 N m (2 copies of each together)"), "{why}");
}

/// A diagram whose angles fall has an arrow of the motion, from right to left; another needs none. A crossing where the curve leaps
/// over the mean line stands on that line.
#[test]
fn a_diagram_tells_which_way_it_is_run_through() {
    use crate::legibility::{has, marks, within};
    for turn in ["ccw", "cw"] {
        let scene = read(&format!(
            r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ "O2": [0, 0] }},
            "links": {{ "2": {{ "joins": ["O2", "A"], "length": 80 }}, "3": {{ "joins": ["A", "B"], "length": 320 }} }},
            "slides": [ {{ "pin": "B", "block": 4, "on": {{ "link": 1, "through": "O2" }} }} ], "near": {{ "B": [380, 0] }},
            "input": {{ "link": 2, "angle": 10, "omega": "90 rpm {turn}" }},
            "loads": [ {{ "name": "P", "on": 4, "force": 900, "direction": "against" }} ],
            "cycle": {{ "load": {{ "of": 2 }}, "rotating": [ {{ "inertia": 2 }} ] }}, "find": ["Ef"] }}"#
        ));
        let figure = figure(&scene, &Wish { kind: Kind::Solution, ..Wish::default() }).unwrap();
        let groups = within(&figure.root);
        let of = |class: &str| groups.iter().filter(|group| has(group, class)).count();
        let diagrams = of("turning-moment") + of("energy");
        assert!(diagrams > 0);
        assert_eq!(of("way-of-motion"), if turn == "cw" { diagrams } else { 0 }, "{turn}");
    }
    let leaps = diagram(
        r#""load": { "table": [[0, 2], [120, 2], [120, 60], [150, 60], [150, 2], [360, 2]] }, "rotating": [ { "inertia": 1 } ]"#,
        r#""Ef""#,
    );
    let figure = figure(&leaps, &Wish { kind: Kind::Solution, ..Wish::default() }).unwrap();
    let groups = within(&figure.root);
    let diagram = groups.iter().find(|group| has(group, "turning-moment")).unwrap();
    let height = |shape: &linkgram::sheet::figure::Shape| match shape {
        linkgram::sheet::figure::Shape::Polyline(points) => points[0].y,
        linkgram::sheet::figure::Shape::Circle { centre, .. } => centre.y,
        other => panic!("{other:?}"),
    };
    let line = within(diagram).into_iter().find(|group| has(group, "mean-line")).unwrap();
    let mean = height(&marks(line).next().unwrap().shape);
    let dots: Vec<f64> =
        marks(diagram).filter(|mark| mark.class == "crossing").map(|mark| height(&mark.shape)).collect();
    assert_eq!(dots.len(), 2);
    assert!(dots.iter().all(|at| (at - mean).abs() < 1e-6), "{dots:?} {mean}");
}
