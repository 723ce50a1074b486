//! The answer key: CSV for people and spreadsheets, JSON for programs.

use serde_json::{Map, Value, json};

use super::{KeyAnswer, Terms, Variant};
use crate::scene::Scene;

/// One line per number to be handed in.
#[must_use]
pub fn csv(variants: &[Variant]) -> String {
    let mut out = String::from("variant,quantity,part,unit,answer,tolerance\n");
    for variant in variants {
        for answer in &variant.answers {
            let fields = [
                variant.name(),
                field(&answer.name),
                answer.part.name().to_owned(),
                field(&answer.unit),
                answer.printed(),
                answer.printed_tolerance(),
            ];
            out.push_str(&fields.join(","));
            out.push('\n');
        }
    }
    out
}

/// A field, in quotes where it has a comma or a quote.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The same for programs, with all digits and with the numbers that each variant has.
#[must_use]
pub fn json(scene: &Scene, terms: &Terms, variants: &[Variant]) -> Value {
    let answer = |a: &KeyAnswer| {
        json!({
            "quantity": a.name, "part": a.part.name(), "unit": a.unit,
            "answer": a.value, "tolerance": a.tolerance, "printed": a.printed(),
        })
    };
    let numbers = |variant: &Variant| -> Map<String, Value> {
        let pairs = scene.vary.iter().zip(&variant.numbers);
        pairs.map(|(v, n)| (v.path.clone(), n.parse::<f64>().map_or(Value::Null, Value::from))).collect()
    };
    let variants: Vec<Value> = variants
        .iter()
        .map(|v| {
            json!({
                "variant": v.name(), "numbers": numbers(v),
                "answers": v.answers.iter().map(answer).collect::<Vec<_>>(),
            })
        })
        .collect();
    json!({
        "scene": scene.title.in_language("en"),
        "seed": terms.seed,
        "hand": { "length_mm": terms.hand.length, "angle_deg": terms.hand.angle.to_degrees() },
        "variants": variants,
    })
}
