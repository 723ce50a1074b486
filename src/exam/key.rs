//! The answer key: CSV for people and spreadsheets, JSON for programs.

use serde_json::{Map, Value, json};

use super::{KeyAnswer, Terms, Variant};
use crate::scene::Scene;

/// One line per number to be handed in.
#[must_use]
pub fn csv(variants: &[Variant]) -> String {
    let mut out = String::from("variant,quantity,part,unit,answer,tolerance,marks,measurable\n");
    for variant in variants {
        for answer in &variant.answers {
            let fields = [
                variant.name(),
                field(&answer.name),
                answer.part.name().to_owned(),
                field(&answer.unit),
                answer.printed(),
                answer.printed_tolerance(),
                weight(answer.weight),
                measurable(answer),
            ];
            out.push_str(&fields.join(","));
            out.push('\n');
        }
    }
    out
}

/// The table into which a student's answers to a variant are typed, with empty boxes; `grade` reads it, and takes an
/// empty box for a question that was not answered.
#[must_use]
pub fn answers_csv(variant: &Variant) -> String {
    let mut out = format!("student,\nvariant,{}\nquantity,value,x,y,unit,sense,direction\n", variant.name());
    for asked in &variant.scene.mechanism.asked {
        if variant.answers.iter().any(|answer| answer.name == asked.name) {
            out.push_str(&format!("{},,,,{},,\n", field(&asked.name), field(&asked.unit.symbol)));
        }
    }
    out
}

/// Whether a careful hand stays within the tolerance; what it may miss by, where not.
fn measurable(answer: &KeyAnswer) -> String {
    match answer.loose {
        None => "yes".to_owned(),
        Some(honest) => format!("no: ± {}", super::answer::fixed(honest, honest, 2)),
    }
}

/// Marks as people write them.
fn weight(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
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
            "marks": a.weight, "loose": a.loose,
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
        "max_tolerance": terms.max_tolerance,
        "loose": terms.loose.name(),
        "variants": variants,
    })
}
