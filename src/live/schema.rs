//! The JSON Schema of `linkgram-live`.

use serde_json::{Value, json};

use super::{FORMAT, VERSION};

/// What stands only where there is something to say.
const OPTIONAL: [&str; 7] = ["column", "value", "name", "links", "turned", "unsigned", "of_position"];

/// The JSON Schema (draft 2020-12) of a drawing that a page runs.
#[must_use]
pub fn schema() -> Value {
    let number = json!({ "type": "number" });
    let integer = json!({ "type": "integer", "minimum": 0 });
    let list = |items: &Value| json!({ "type": "array", "items": items });
    let tuple = |items: &[Value]| {
        json!({
            "type": "array", "prefixItems": items, "items": false, "minItems": items.len(), "maxItems": items.len(),
        })
    };
    let object = |description: &str, properties: Value| {
        let required: Vec<&String> = properties.as_object().into_iter().flat_map(|all| all.keys()).collect();
        let required = required.into_iter().filter(|key| !OPTIONAL.contains(&key.as_str()));
        json!({
            "type": "object", "description": description, "required": required.collect::<Vec<_>>(),
            "additionalProperties": false, "properties": properties,
        })
    };
    let or_null = |of: &Value| json!({ "oneOf": [of, { "type": "null" }] });
    let variable = object(
        "What is varied; SI units, radians.",
        json!({
            "kind": { "enum": ["angle", "slide", "time"] },
            "told": { "type": "string", "description": "What stands above its column." },
            "of": { "description": "The number of the driven link, or of the slide.", "type": ["integer", "null"] },
            "over_time": { "type": "boolean" },
            "unit": { "type": "string" },
            "si": { "type": "number", "description": "SI units per unit." },
            "start": { "type": "number", "description": "The scene's own position." },
            "range": tuple(&[number.clone(), number.clone()]),
            "whole_turn": { "type": "boolean", "description": "After the range everything comes again." },
            "rate": { "type": "number", "description": "SI units per second; over time 1." },
        }),
    );
    let program = object(
        "The operations of the drawing. Row 0 is the input; every row is written once.",
        json!({
            "rows": integer,
            "lots": { "type": "integer", "description": "Signs of the input's rounding, one bit for each of eight samples." },
            "constants": list(&tuple(&[integer.clone(), number.clone(), integer.clone()])),
            "code": {
                "description": "Eight integers for a step: kind, row, row of the second result (0: none), four operands, \
                                signs of its rounding + 256 where it is divided by. Kinds: 0 a+b, 1 a-b, 2 -a, 3 ab, \
                                4 a/b, 5 root of a, 6 root of a times sign b, 7 ab+cd, 8 ab-cd, 9 cosine (second: sine), \
                                10 sine (second: cosine), 11 angle of (b, a), 12 the same near so many half turns as \
                                the sign c past the chords' says, 13 the greatest whole number up to a, 14 where row a vanishes, found by trial with the \
                                steps up to place b of the code (second: how row a changes there), expected as the \
                                four signs c past the half turns say (a place, what stands there, how it moves on, \
                                sense of the change), in steps of d.",
                "type": "array", "items": integer,
            },
            "signs": { "type": "integer", "description": "How many signs of half chords stand before the half turns." },
            "turned": { "type": "integer", "description": "How many half turns stand before what is found by trial." },
            "chords": list(&tuple(&[integer.clone(), integer.clone(), or_null(&integer)])),
            "turns": list(&tuple(&[integer.clone(), integer.clone()])),
            "divisors": list(&tuple(&[integer.clone(), integer.clone()])),
        }),
    );
    let stretch = object(
        "Where the mechanism moves freely.",
        json!({
            "from": number, "to": number,
            "signs": list(&number),
            "apart": { "type": "boolean", "description": "Not reached without taking the mechanism apart." },
        }),
    );
    let event = object(
        "Something that happens on the way.",
        json!({
            "at": number,
            "kind": { "enum": ["limit", "change point", "dead position", "at infinity", "least", "greatest"] },
            "column": { "type": ["integer", "null"] },
            "value": number,
            "name": { "type": "string" },
            "links": list(&integer),
        }),
    );
    let output = object(
        "A number: a scalar, or a coordinate of a vector. SI units in its row.",
        json!({
            "row": integer,
            "name": { "type": "string" },
            "axis": { "enum": [0, 1, null] },
            "unit": { "type": "string" },
            "si": number,
            "unsigned": { "type": "boolean", "description": "True where it counts without its sign." },
            "of_position": { "type": "boolean", "description": "True where it is known wherever the mechanism stands." },
            "asked": { "type": "boolean" },
        }),
    );
    let mut schema = object(
        "A drawing of a mechanism, written down to be run for other places of its input.",
        json!({
            "format": { "const": FORMAT },
            "version": { "const": VERSION },
            "program_version": { "type": "string" },
            "language": { "type": "string" },
            "variable": variable,
            "program": program,
            "course": object("Stretches and events, ascending.", json!({ "stretches": list(&stretch), "events": list(&event) })),
            "outputs": list(&output),
            "behind": list(&list(&integer)),
            "reasons": list(&list(&integer)),
        }),
    );
    schema["properties"]["stuck"] = list(&json!({ "enum": ["at_rest", "locked", null] }));
    schema["properties"]["program"]["properties"]["noise"] = list(&tuple(&[integer.clone(), number.clone()]));
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("linkgram-live");
    schema
}
