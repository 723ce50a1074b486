//! Statements that once failed, with their truth: whatever the generator makes today, these stay.
//!
//! Each file has the scene, the names that are asked with what is true of them in SI units (or the direction in which a centre
//! lies at infinity), and what went wrong. Where places
//! have room, how far that leads is what an answer's own bound says, which has to cover the truth; the file then says within
//! which part of the largest number of a kind an answer stays besides: no bound is so wide that it says nothing.

use std::path::Path;

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene;
use linkgram::sheet::scale;
use linkgram::solve::{solve, solve_analytically};
use serde_json::{Value, json};

fn numbers(answer: &Answer) -> Vec<f64> {
    match answer {
        Answer::Scalar { value, .. } => vec![*value],
        Answer::Vector { value, .. } => value.to_vec(),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => Vec::new(),
    }
}

/// Whether an answer lies at infinity in this direction, of which the half turn is left open.
fn lies_toward(answer: &Answer, direction: &Value) -> bool {
    let Answer::AtInfinity { direction: [x, y], .. } = answer else { return false };
    let of = |k: usize| direction[k].as_f64().unwrap();
    (x * of(1) - y * of(0)).abs() < 1e-8
}

/// By how much an answer says that it may be off.
fn bound(answer: &Answer) -> f64 {
    match answer {
        Answer::Scalar { bound, .. } | Answer::Vector { bound, .. } => *bound,
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => 0.0,
    }
}

fn complaints(name: &str, kept: &Value) -> Vec<String> {
    let truth = kept["truth"].as_object().unwrap();
    let names: Vec<&String> = truth.keys().collect();
    let mut text = kept["scene"].clone();
    text["find"] = json!(names);
    let read = match scene::read(&text.to_string(), name) {
        Ok(read) => read,
        Err(error) => return vec![format!("{name}: {error}")],
    };
    let values = |name: &str| -> Vec<f64> {
        let value = &truth[name];
        value
            .as_array()
            .map_or_else(|| vec![value], |all| all.iter().collect())
            .into_iter()
            .filter_map(Value::as_f64)
            .collect()
    };
    let size = |name: &str| {
        let kind = name.split('(').next();
        let alike = names.iter().filter(|other| other.split('(').next() == kind);
        alike.flat_map(|other| values(other)).fold(0.0_f64, |size, v| size.max(v.abs()))
    };
    let stated = kept["within"].as_f64();
    let within = stated.unwrap_or(1e-8);
    let mut all = Vec::new();
    let mut hold = |solver: &str, asked: &str, answer: &Answer| {
        if let Some(direction) = truth[asked].get("at_infinity") {
            if !lies_toward(answer, direction) {
                all.push(format!(
                    "{name}, {solver}: {asked} is {answer:?}, not at infinity along {direction}"
                ));
            }
            return;
        }
        let (found, truth) = (numbers(answer), values(asked));
        let near = found.len() == truth.len()
            && found.iter().zip(&truth).all(|(a, b)| (a - b).abs() <= within * size(asked));
        let apart =
            found.iter().zip(&truth).fold(0.0_f64, |square, (a, b)| square + (a - b) * (a - b)).sqrt();
        // The truth has digits of a double, too.
        let covered = stated.is_none() || apart <= bound(answer) + 4.0 * f64::EPSILON * size(asked);
        if !near || !covered {
            all.push(format!("{name}, {solver}: {asked} is {answer:?}, not {truth:?}"));
        }
    };
    match solve(&read, Extent::Asked, scale::for_scene) {
        Ok(solved) => {
            for (asked, reading) in names.iter().zip(&solved.solution.construction.answers) {
                hold("drawn", asked, &reading.answer);
            }
        }
        Err(error) => return vec![format!("{name}: {error}")],
    }
    match solve_analytically(&read) {
        Ok(state) => {
            for (asked, quantity) in names.iter().zip(&read.mechanism.asked) {
                hold("reckoned", asked, &state.answer(&quantity.quantity));
            }
        }
        Err(error) => all.push(format!("{name}, reckoned: {error}")),
    }
    all
}

#[test]
fn what_once_failed_has_its_truth() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/statements");
    let mut all = Vec::new();
    let mut held = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        let kept: Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
        all.extend(complaints(&name, &kept));
        held += 1;
    }
    assert!(all.is_empty(), "{} complaints\n{}", all.len(), all.join("\n"));
    assert!(held > 4, "{held} statements");
}
