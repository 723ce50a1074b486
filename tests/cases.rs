//! The textbook cases against values that were recomputed outside this project, senses included.
//!
//! `data/recomputed.json` is copied from the case files: one entry per scene, and per value its key in
//! the case, the decimal text as it stands there, and which quantity of the scene it is. Both solvers
//! must give every value to the last digit written. `along` and `across` give the direction in which a
//! vector was recomputed with a sign: a stated one, or from one joint to another, or that turned a
//! quarter ccw. `scale` is the reading of a millimetre of paper, for the ends of polygons. `within` stands
//! where the case rounded its own fitted dimensions or crank angle, so that its last digits are not theirs.
//! Instant centres are not drawn yet, so only the analytic solver answers for them.

#![allow(clippy::unwrap_used, clippy::disallowed_methods, reason = "a test")]

use std::path::Path;

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene;
use linkgram::sheet::scale;
use linkgram::solve::{solve, solve_analytically};
use serde_json::{Value, json};

/// Its name in complaints.
const ANALYTIC: &str = "analytic";

/// Half a unit in the last place of a decimal text.
fn half_a_digit(text: &str) -> f64 {
    let decimals = text.split_once('.').map_or(0, |(_, d)| d.len());
    0.5 * 10_f64.powi(-i32::try_from(decimals).unwrap())
}

/// A wider tolerance for a case whose own rounding spoils its digits, relative to the value.
fn allowed(row: &Value, text: &str) -> f64 {
    let within = row["within"].as_str().map_or(0.0, |w| w.parse::<f64>().unwrap());
    // One part in a thousand for a value that ends in a five.
    half_a_digit(text) * 1.001 + within * number(text).abs()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// Everything a row needs: the asked quantity, and the places that give its direction.
fn finds(rows: &[Value]) -> Vec<Value> {
    let mut finds: Vec<Value> = Vec::new();
    let mut add = |find: Value| {
        if !finds.contains(&find) {
            finds.push(find);
        }
    };
    for row in rows {
        add(json!({ "name": row["find"], "unit": row["unit"] }));
        for key in ["along", "across"] {
            for joint in row[key].as_array().into_iter().flatten().filter_map(Value::as_str) {
                add(json!({ "name": format!("x({joint})"), "unit": "m" }));
            }
        }
    }
    finds
}

/// Answers by one solver, in the asked units.
struct Answers<'a> {
    finds: &'a [Value],
    values: Vec<Answer>,
    units: Vec<f64>,
}

impl Answers<'_> {
    fn of(&self, name: &Value, unit: &Value) -> Result<(Vec<f64>, f64), String> {
        let wanted = json!({ "name": name, "unit": unit });
        let index = self.finds.iter().position(|f| *f == wanted).unwrap();
        let si = self.units[index];
        match &self.values[index] {
            Answer::Scalar { value, bound } => Ok((vec![value / si], bound / si)),
            Answer::Vector { value, bound } => Ok((value.map(|v| v / si).to_vec(), bound / si)),
            other => Err(format!("{other:?}")),
        }
    }

    fn direction(&self, row: &Value) -> Option<[f64; 2]> {
        let (given, turned) = match (&row["along"], &row["across"]) {
            (Value::Array(given), _) => (given, false),
            (_, Value::Array(given)) => (given, true),
            _ => return None,
        };
        let [first, second] = given.as_slice() else { panic!("{row}: a direction has two entries") };
        let [x, y] = match (first.as_f64(), second.as_f64()) {
            (Some(x), Some(y)) => [x, y],
            _ => {
                let at = |joint: &Value| {
                    let name = json!(format!("x({})", joint.as_str().unwrap()));
                    self.of(&name, &json!("m")).unwrap().0
                };
                let (from, to) = (at(first), at(second));
                let [x, y] = [to[0] - from[0], to[1] - from[1]];
                [x / x.hypot(y), y / x.hypot(y)]
            }
        };
        Some(if turned { [-y, x] } else { [x, y] })
    }

    /// What is wrong with one row.
    fn complaint(&self, row: &Value) -> Option<String> {
        let (value, bound) = match self.of(&row["find"], &row["unit"]) {
            Ok(found) => found,
            Err(why) => return Some(format!("{}: {why}", row["find"])),
        };
        let scale = row["scale"].as_f64().unwrap_or(1.0);
        let texts: Vec<&str> = match &row["value"] {
            Value::String(text) => vec![text],
            Value::Array(texts) => texts.iter().map(|t| t.as_str().unwrap()).collect(),
            other => panic!("{other}: not decimal text"),
        };
        let computed: Vec<f64> = match (value.as_slice(), texts.len(), self.direction(row)) {
            ([x, y], 1, Some([ex, ey])) => {
                let (along, beside) = (x * ex + y * ey, y * ex - x * ey);
                if beside.abs() > 1e-9 * along.abs() + bound {
                    return Some(format!("{}: ({x}, {y}) does not lie along ({ex}, {ey})", row["key"]));
                }
                vec![along]
            }
            ([x, y], 1, None) => vec![x.hypot(*y)],
            ([_], 1, None) | ([_, _], 2, None) => value,
            _ => panic!("{row}: a vector for a scalar"),
        };
        for (computed, text) in computed.iter().map(|c| c / scale).zip(&texts) {
            let difference = computed - number(text);
            // An angle is one angle however many turns it is said to have.
            let whole = if row["unit"] == json!("deg") { 360.0 } else { f64::INFINITY };
            let difference = difference.abs().min((difference.abs() - whole).abs());
            if difference > allowed(row, text) + bound / scale {
                return Some(format!("{} = {}: recomputed {text}, here {computed}", row["key"], row["find"]));
            }
        }
        None
    }
}

fn check(entry: &Value) -> Vec<String> {
    let path = entry["scene"].as_str().unwrap();
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap();
    let mut object: Value = serde_json::from_str(&text).unwrap();
    let rows = entry["values"].as_array().unwrap();
    let finds = finds(rows);
    object["find"] = json!(finds);
    for key in ["published", "errata"] {
        object.as_object_mut().unwrap().remove(key);
    }
    let scene = scene::read(&object.to_string(), path).unwrap_or_else(|error| panic!("{error}"));
    let units: Vec<f64> = scene.mechanism.asked.iter().map(|a| a.unit.si).collect();
    let complain = |solver: &str, values: Vec<Answer>| -> Vec<String> {
        let answers = Answers { finds: &finds, values, units: units.clone() };
        rows.iter()
            .filter_map(|row| answers.complaint(row))
            .map(|c| format!("{path}, {solver}: {c}"))
            .collect()
    };
    let drawn = match solve(&scene, Extent::Asked, scale::for_scene) {
        Ok(solved) => solved.solution.construction.answers.into_iter().map(|r| r.answer).collect(),
        Err(error) => return vec![format!("{path}: {error}")],
    };
    let mut complaints = complain("graphical", drawn);
    let state = solve_analytically(&scene).unwrap_or_else(|error| panic!("{path}: {error}"));
    complaints.extend(complain(
        ANALYTIC,
        scene.mechanism.asked.iter().map(|a| state.answer(&a.quantity)).collect(),
    ));
    complaints
}

fn table() -> Vec<Value> {
    serde_json::from_str(include_str!("data/recomputed.json")).unwrap()
}

#[test]
fn both_solvers_give_the_recomputed_values() {
    let complaints: Vec<String> = table().iter().flat_map(check).collect();
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}
