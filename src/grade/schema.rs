//! The JSON Schema of answers, for editors.

use serde_json::{Value, json};

/// The JSON Schema (draft 2020-12) of a file of answers.
#[must_use]
pub fn schema() -> Value {
    let number = json!({
        "description": "A number in the units of bare numbers, or text with its unit: \"170 cm/s\", \"2.1 rad/s ccw\". \
                        Without cw or ccw a positive rate is a magnitude; a negative one is clockwise.",
        "type": ["number", "string"],
    });
    let point = json!({
        "type": "array", "prefixItems": [{ "type": "number" }, { "type": "number" }],
        "minItems": 2, "maxItems": 2, "items": false,
    });
    let points = json!({ "type": "object", "additionalProperties": point });
    let by_figure = |description: &str, value: &Value| {
        json!({
            "type": "object", "description": description, "additionalProperties": false,
            "properties": { "velocity": value, "acceleration": value, "skeleton": value },
        })
    };
    let reference = json!({
        "type": "object", "required": ["pixels", "mm"], "additionalProperties": false,
        "properties": {
            "pixels": { "type": "array", "items": point, "minItems": 2, "maxItems": 2, "description": "x right, y down." },
            "mm": { "type": "array", "items": point, "minItems": 2, "maxItems": 2, "description": "x right, y up." },
        },
    });
    let value = json!({
        "oneOf": [
            number,
            point,
            {
                "type": "object", "additionalProperties": false,
                "properties": {
                    "magnitude": number,
                    "value": number,
                    "direction": { "type": ["number", "string"], "description": "Ccw from +x, world axes." },
                    "sense": { "enum": ["cw", "ccw"] },
                    "components": point,
                    "unit": { "type": "string", "examples": ["cm/s"] },
                    "through": { "description": "Of a force: a point of its line, world axes.", "allOf": [point] },
                },
            },
        ],
    });
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Answers to a linkgram scene",
        "type": "object",
        "description": "What a student handed in, in any mix of values, measured lengths and points of the drawing.",
        "additionalProperties": false,
        "properties": {
            "$schema": { "type": "string", "description": "Address of this schema, for editors." },
            "student": { "type": "string" },
            "variant": { "type": "string", "description": "Of an exam: which variant was solved.", "examples": ["007"] },
            "units": {
                "type": "object", "additionalProperties": { "type": "string" },
                "propertyNames": { "enum": ["length", "angle", "time"] },
                "description": "Units of bare numbers; those of the scene where nothing is said.",
            },
            "values": {
                "type": "object", "additionalProperties": value,
                "description": "Values by the name of the quantity, as in a scene's `find`.",
                "examples": [{ "v(B)": "170 cm/s", "omega(3)": "2.1 rad/s ccw" }],
            },
            "scales": {
                "type": "object", "additionalProperties": false,
                "properties": {
                    "length": { "type": "string", "examples": ["1:10"] },
                    "velocity": { "type": "string", "examples": ["50 cm/s per cm"] },
                    "acceleration": { "type": "string", "examples": ["500 cm/s^2 per cm"] },
                    "force": { "type": "string", "examples": ["100 N per cm"] },
                },
                "description": "Scale factors of the student's drawing; those of the solution sheet where nothing is said.",
            },
            "lengths": {
                "type": "object", "additionalProperties": { "type": "number", "minimum": 0 },
                "description": "Lengths of vectors measured on the drawing, mm, by the name of the quantity.",
            },
            "points": by_figure(
                "Points read off the drawing, mm, x right, y up, any origin. Polygons: names as the sheet prints them, the pole `o` among them; skeleton: at least one fixed point.",
                &points,
            ),
            "scan": by_figure("The points of that figure are pixels of a scan; two reference points give scale and rotation.", &reference),
            "drawing": {
                "type": "string",
                "description": "An SVG of a vector editor, beside this file: a letter names the dot or line end next to it; A is a joint, a its velocity image, a′ its acceleration image, or layers named velocity, acceleration, skeleton tell the figures apart.",
                "examples": ["student.svg"],
            },
            "tolerance": {
                "type": "object", "additionalProperties": { "type": ["number", "string"] },
                "description": "Of answers that the examiner wrote himself, such as a textbook's (`--trust-answers`); of what a student hands in it does not count. `length` and `angle`: how exact the hand is (0.2 mm, 0.3 deg). By the name of a quantity: its own tolerance.",
                "examples": [{ "length": "0.2 mm", "angle": "0.3 deg", "v(B)": "3 %" }],
            },
        },
    })
}
