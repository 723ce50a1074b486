//! Output units: what `find` asks for in a unit is answered in it.

use std::io::Write;
use std::process::{Command, Stdio};

use serde_json::{Value, json};

use super::asked::Truth;
use super::mechanism::length;
use crate::extremes::dice::Dice;

/// Units by dimension, with what they are in SI.
const LENGTHS: [(&str, f64); 5] = [("mm", 1e-3), ("cm", 1e-2), ("m", 1.0), ("in", 0.0254), ("ft", 0.3048)];
const TIMES: [(&str, f64); 3] = [("s", 1.0), ("ms", 1e-3), ("min", 60.0)];
const ANGLES: [(&str, f64); 3] =
    [("rad", 1.0), ("deg", std::f64::consts::PI / 180.0), ("rev", 2.0 * std::f64::consts::PI)];

/// A unit for this name, with what it is in SI; `None` where it has none of its own.
fn unit(name: &str, dice: &mut Dice) -> Option<(String, f64)> {
    let (length, time, angle) = (dice.of(&LENGTHS), dice.of(&TIMES), dice.of(&ANGLES));
    let kind = name.split('(').next()?;
    Some(match kind {
        "x" | "I" => (length.0.to_owned(), length.1),
        "v" | "slip" | "rub" => (format!("{}/{}", length.0, time.0), length.1 / time.1),
        "a" | "an" | "at" | "aslip" | "aslipn" | "aslipt" | "coriolis" => {
            (format!("{}/{}^2", length.0, time.0), length.1 / time.1 / time.1)
        }
        "omega" if dice.chance(0.3) => ("rpm".to_owned(), std::f64::consts::PI / 30.0),
        "omega" => (format!("{}/{}", angle.0, time.0), angle.1 / time.1),
        "alpha" => (format!("{}/{}^2", angle.0, time.0), angle.1 / time.1 / time.1),
        "angle" => (angle.0.to_owned(), angle.1),
        _ => return None,
    })
}

/// What the program prints for a scene.
fn printed(scene: &Value) -> Value {
    let mut program = Command::new(env!("CARGO_BIN_EXE_linkgram"))
        .args(["solve", "-", "--json"])
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    program.stdin.take().unwrap().write_all(scene.to_string().as_bytes()).unwrap();
    let output = program.wait_with_output().unwrap();
    serde_json::from_slice(&output.stdout).unwrap_or(Value::Null)
}

#[test]
fn answers_come_in_the_units_that_are_asked() {
    let mut held = 0;
    for seed in 0..24 {
        let Ok(case) = super::case(seed) else { continue };
        if !super::judge::judge(&case.scene, &case.asked).faults.is_empty() {
            continue;
        }
        let mut dice = Dice::new(seed ^ 0x7517);
        let units: Vec<Option<(String, f64)>> = case.asked.iter().map(|a| unit(&a.name, &mut dice)).collect();
        let find: Vec<Value> = case
            .asked
            .iter()
            .zip(&units)
            .map(|(asked, unit)| match unit {
                Some((unit, _)) => json!({ "name": asked.name, "unit": unit }),
                None => json!(asked.name),
            })
            .collect();
        let mut scene = case.scene.clone();
        scene["find"] = Value::Array(find);
        let said = printed(&scene);
        let quantities = said["quantities"].as_array().unwrap_or_else(|| panic!("seed {seed}: {scene}"));
        for ((asked, unit), quantity) in case.asked.iter().zip(&units).zip(quantities) {
            let Some((symbol, si)) = unit else { continue };
            let number = |value: &Value| value.as_f64().map(|x| x * si);
            let (apart, size) = match &asked.truth {
                Truth::Scalar(truth) => {
                    let Some(value) = number(&quantity["value"]) else { continue };
                    let value = if asked.name.starts_with("rub") { value.abs() } else { value };
                    ((value - truth).abs(), truth.abs())
                }
                Truth::Vector(truth) => {
                    let [Some(x), Some(y)] = [0, 1].map(|k| number(&quantity["value"][k])) else { continue };
                    (length([x - truth[0], y - truth[1]]), length(*truth))
                }
                Truth::Angle(_) | Truth::AtInfinity(_) => continue,
            };
            let bound = number(&quantity["bound"]).unwrap();
            let name = &asked.name;
            assert!(
                apart <= asked.off + (1.0 + 1e-9) * bound + 1e-12 * size,
                "seed {seed}: {name} in {symbol}: {quantity}, off by {apart:e}\n{scene}"
            );
            held += 1;
        }
    }
    assert!(held > 300, "{held} quantities");
}
