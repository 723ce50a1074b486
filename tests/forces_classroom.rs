//! Forces in the classroom: what of them may vary, what a variant needs, what a sweep tells, and how a force is handed in.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::process::Command;

use linkgram::exam::{self, ExamError, Terms};
use linkgram::grade::{self, Verdict};
use linkgram::scene;
use linkgram::sweep::governor::{Governed, Stability, governed};
use serde_json::Value;

use crate::common;

fn terms(variants: usize) -> Terms {
    common::hand_in::terms(variants, 7, exam::Loose::default())
}

/// A slider-crank with everything that a scene of forces may say.
const ALL: &str = r#"{ "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O2": [0, 0] },
  "links": { "2": { "joins": ["O2", "A"], "length": 60 }, "3": { "joins": ["A", "B"], "length": 220 } },
  "slides": [ { "pin": "B", "block": 4, "f": 0.2, "on": { "link": 1, "through": "O2" } } ],
  "near": { "B": [240, 0] }, "input": { "link": 2, "angle": ANGLE, "omega": "10 rad/s ccw" },
  "pins": { "B": { "radius": 20, "f": 0.18 } }, "gravity": { "g": 9.81, "direction": -90 },
  "masses": { "3": { "weight": "20 N", "at": [75, 0], "inertia": 0.02 } },
  "loads": [ { "name": "P", "on": 4, "force": "1500 N", "direction": "against" } ],
  "springs": [ { "between": [ { "link": 4, "at": "B" }, { "link": 1, "at": [400, 0] } ], "stiffness": "2 N/mm", "free": 120 } ],
  "find": ["T(2)"], "vary": VARY }"#;

fn all(angle: &str, vary: &str) -> Result<scene::Scene, String> {
    let text = ALL.replace("ANGLE", angle).replace("VARY", vary);
    scene::read(&text, "all").map_err(|diagnostic| diagnostic.to_string())
}

#[test]
fn every_number_of_the_forces_may_vary_and_no_name_of_a_link() {
    let range = r#"{ "from": 1, "to": 2, "step": 1 }"#;
    for path in [
        "masses.3.weight",
        "masses.3.at[0]",
        "masses.3.inertia",
        "loads[0].force",
        "pins.B.f",
        "pins.B.radius",
        "slides[0].f",
        "gravity.g",
        "springs[0].stiffness",
        "springs[0].between[1].at[0]",
    ] {
        let scene = all("50", &format!("{{ \"{path}\": {range} }}")).unwrap();
        assert_eq!(scene.vary[0].path, path);
    }
    for path in ["loads[0].on", "springs[0].between[0].link", "masses.3"] {
        let refused = all("50", &format!("{{ \"{path}\": {range} }}")).unwrap_err();
        assert!(refused.contains("is not a given number"), "{refused}");
    }
    let cycle = r#"{ "links": {}, "input": { "omega": "300 rpm" },
      "cycle": { "torque": { "table": [[0, 0], [60, 800], [180, 0], [360, 0]] }, "fluctuation": 0.02 },
      "find": ["Ef"], "vary": { "cycle.torque.table[1][1]": { "from": 700, "to": 900, "step": 50 } } }"#;
    assert_eq!(scene::read(cycle, "cycle").unwrap().vary[0].own, 800.0);
}

#[test]
fn a_variant_rubs_as_the_scene_does_and_its_lengths_can_be_measured() {
    let refused =
        |angle: &str, vary: &str| match exam::draw(&all(angle, vary).unwrap(), &terms(9), 2, &|_| {}) {
            Err(ExamError::Exhausted { tally, .. }) => tally.to_string(),
            other => panic!("{other:?}"),
        };
    // Beyond 90° the rod turns the other way at B, and so does the block on it.
    let told = refused("50", r#"{ "input.angle": { "from": 50, "to": 130, "step": 10 } }"#);
    assert!(told.contains("rub the other way") || told.contains("rubs the other way"), "{told}");
    // Near the dead centre the arm of the rod's force is too short.
    let told = refused("50", r#"{ "input.angle": { "from": 1, "to": 9, "step": 1 } }"#);
    assert!(told.contains("too short to be measured"), "{told}");
}

fn program(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

fn file(name: &str, text: &str) -> std::path::PathBuf {
    let path = std::env::temp_dir().join(format!("linkgram-classroom-{}-{name}", std::process::id()));
    std::fs::write(&path, text).unwrap();
    path
}

#[test]
fn a_sweep_tells_sizes_and_directions_and_both_sides_of_a_reversal() {
    let scene = format!("{}/examples/forces/friction-slider-crank.json", env!("CARGO_MANIFEST_DIR"));
    let path = file("sweep.json", "");
    let to = path.to_str().unwrap();
    program(&["sweep", &scene, "--steps", "8", "--only", "T(2),F(3,4)", "-o", to]);
    let told: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let _ = std::fs::remove_file(&path);
    let names: Vec<&str> =
        told["columns"].as_array().unwrap().iter().map(|column| column["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["T(2)", "F(3,4).x", "F(3,4).y", "F(3,4).size", "F(3,4).direction"]);
    let number = |value: &Value| value.as_f64().unwrap();
    for row in told["positions"].as_array().unwrap() {
        let values: Vec<f64> = row["values"].as_array().unwrap().iter().map(number).collect();
        assert!((libm::hypot(values[1], values[2]) - values[3]).abs() < 1e-9 * values[3]);
        assert!((libm::atan2(values[2], values[1]).to_degrees() - values[4]).abs() < 1e-9);
    }
    // At 90° the block begins to turn the other way on the rod; the scene itself, just before and just after.
    let text = std::fs::read_to_string(&scene).unwrap();
    let reversal =
        told["reversals"].as_array().unwrap().iter().find(|r| (number(&r["at"]) - 90.0).abs() < 1e-6);
    let reversal = reversal.unwrap();
    for (side, angle) in [("before", 89.999_9), ("after", 90.000_1)] {
        let beside = common::read(&text.replace("\"angle\": 50", &format!("\"angle\": {angle}")));
        let state = linkgram::solve::solve_analytically(&beside).unwrap();
        let linkgram::mechanism::quantity::Answer::Scalar { value, .. } =
            state.answer(&beside.mechanism.asked[0].quantity)
        else {
            panic!("no torque")
        };
        let told = number(&reversal[side][0]);
        assert!((value - told).abs() < 1e-4 * value.abs(), "{side}: {value} {told}");
    }
    assert!((number(&reversal["before"][0]) - number(&reversal["after"][0])).abs() > 0.05);
}

#[test]
fn a_cycle_is_swept_into_its_table_of_levels() {
    // A triangle of height 800 over half a turn: mean 200, so that a quarter of each flank lies below it.
    let scene = file(
        "levels.json",
        r#"{ "units": { "torque": "N*m" }, "links": {}, "input": { "omega": "300 rpm" },
          "cycle": { "torque": { "table": [[0, 0], [90, 800], [180, 0], [360, 0]] } }, "find": ["Ef"] }"#,
    );
    let to = file("levels.csv", "");
    program(&["sweep", scene.to_str().unwrap(), "-o", to.to_str().unwrap()]);
    let table = std::fs::read_to_string(&to).unwrap();
    let rows: Vec<Vec<f64>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').map(|cell| cell.parse().unwrap()).collect())
        .collect();
    let quarter = std::f64::consts::FRAC_PI_2;
    // Below the mean from 0 to 22.5°, above it to 157.5°.
    let low = -0.25 * quarter * 200.0 / 2.0;
    let high = low + 1.5 * quarter * 600.0 / 2.0;
    for (row, right) in rows.iter().zip([[22.5, low, high - low], [157.5, high, low - high]]) {
        for (told, right) in [row[1], row[3], row[4]].iter().zip(right) {
            assert!((told - right).abs() < 1e-9 * right.abs(), "{row:?} {right}");
        }
    }
    assert_eq!(rows.len(), 2);
    for path in [scene, to] {
        let _ = std::fs::remove_file(path);
    }
}

fn kind(name: &str) -> String {
    let kind = linkgram::catalogue::KINDS.iter().find(|kind| kind.name == name).unwrap();
    kind.scene.to_owned()
}

fn led(text: &str) -> Governed {
    governed(&common::read(text).mechanism, None).unwrap().unwrap()
}

#[test]
fn a_governor_is_stable_where_its_speed_grows_with_the_radius() {
    // Porter with both pivots on the axis and equal arms: ω² = (m + M ± F/g) g / (m h), h the height of the arms.
    let porter = led(&kind("governor-porter"));
    assert!(porter.places.len() > 50);
    for place in &porter.places {
        let height = (0.25_f64 * 0.25 - place.radius * place.radius).sqrt();
        for (told, drag) in place.rising_falling.iter().zip([20.0, -20.0]) {
            let right = ((4.0 + 24.0 + drag / 9.81) * 9.81 / (4.0 * height)).sqrt();
            assert!((told - right).abs() < 1e-6 * right, "{place:?} {right}");
        }
    }
    assert_eq!(porter.parts.iter().map(|part| part.stability).collect::<Vec<_>>(), [Stability::Stable]);
    // A spring that hardly gives way pushes with nearly one force: the farther out, the slower.
    let soft = kind("governor-hartnell")
        .replace("\"stiffness\": 18, \"free\": 200", "\"stiffness\": 1, \"free\": 1500");
    let soft = led(&soft);
    assert!(soft.parts.iter().all(|part| part.stability == Stability::Unstable), "{:?}", soft.parts);
}

#[test]
fn members_of_two_and_three_forces_are_told() {
    let scene = format!("{}/src/catalogue/press.json", env!("CARGO_MANIFEST_DIR"));
    let told: Value = serde_json::from_str(&program(&["structure", "--json", &scene])).unwrap();
    assert_eq!(told["forces"]["two_force_members"], serde_json::json!([3, 4, 5]));
    assert_eq!(told["forces"]["three_force_members"], serde_json::json!([6]));
    assert_eq!(told["forces"]["order_of_balance"], serde_json::json!([[5, 6], [3, 4], [2]]));
    let bare = format!("{}/src/catalogue/toggle-press.json", env!("CARGO_MANIFEST_DIR"));
    let told: Value = serde_json::from_str(&program(&["structure", "--json", &bare])).unwrap();
    assert!(told.get("forces").is_none());
}

/// A weightless bar of 100 mm on O4, held at 90° by a torque against 100 N to the right at its end: F(1,2) is −100 N.
const BAR: &str = r#"{ "units": { "length": "mm", "torque": "N*m" }, "fixed": { "O": [0, 0] },
  "links": { "2": { "joins": ["O", "A"], "length": 100 } }, "input": { "link": 2, "angle": 90 },
  "loads": [ { "name": "P", "on": 2, "at": "A", "force": 100, "direction": 0 } ], "find": ["F(1,2)", "T(2)"] }"#;

fn verdicts(answers: &str) -> Vec<(String, Verdict)> {
    let scene = common::read(BAR);
    let answers = grade::read_answers(answers, &scene).unwrap();
    let report = grade::grade(&scene, &answers, &grade::GradeSettings::default()).unwrap();
    report.quantities.iter().map(|graded| (graded.name.clone(), graded.verdict)).collect()
}

#[test]
fn a_force_is_handed_in_by_size_direction_components_line_or_length() {
    let right = |answers: &str| {
        let all = verdicts(answers);
        assert!(all.iter().all(|(_, verdict)| *verdict == Verdict::Right), "{answers}: {all:?}");
    };
    right(
        r#"{ "values": { "F(1,2)": { "magnitude": "100 N", "direction": "180 deg" }, "T(2)": "10 N*m ccw" } }"#,
    );
    right(r#"{ "values": { "F(1,2)": { "components": [-100, 0], "through": [0, 0] } } }"#);
    right(r#"{ "values": { "F(1,2)": 100, "T(2)": { "value": 10, "sense": "ccw" } } }"#);
    right(r#"{ "scales": { "force": "20 N per cm" }, "lengths": { "F(1,2)": 50 } }"#);
    let wrong = |answers: &str| {
        let all = verdicts(answers);
        assert!(all.iter().any(|(_, verdict)| *verdict == Verdict::Wrong), "{answers}: {all:?}");
    };
    wrong(r#"{ "values": { "F(1,2)": { "magnitude": "100 N", "direction": "0 deg" } } }"#);
    wrong(r#"{ "values": { "F(1,2)": { "components": [-100, 0], "through": [0, 40] } } }"#);
    wrong(r#"{ "values": { "T(2)": "10 N*m cw" } }"#);
    wrong(r#"{ "scales": { "force": "20 N per cm" }, "lengths": { "F(1,2)": 65 } }"#);
}
