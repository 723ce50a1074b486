//! The JSON Schema of a scene, for editors.

use serde_json::{Value, json};

use super::asked::{heads, names_of_quantities};
use super::sheet::{LANGUAGES, LIVE_PANELS, LIVE_SCALES, NOTATIONS, PAPERS, PLAY_SECONDS, THEMES};
use super::units::names;
use crate::limits::POSITIONS;
use crate::mechanism::quantity::Method;

/// The JSON Schema (draft 2020-12) of a scene: what an editor needs to complete and to check it.
///
/// It says which keys there are and what stands behind them. What only the reader can know (that a
/// point exists, that a triangle closes) it does not say.
#[must_use]
pub fn schema() -> Value {
    let mut schema = scene();
    schema["$defs"] = Value::Object(definitions());
    schema
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// A reference with a description of its own.
fn described(name: &str, description: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}"), "description": description })
}

fn object(description: &str, required: &[&str], properties: Value) -> Value {
    json!({
        "type": "object", "description": description, "required": required,
        "additionalProperties": false, "properties": properties,
    })
}

fn by_point(description: &str, value: &Value) -> Value {
    json!({
        "type": "object", "description": description,
        "propertyNames": reference("point"), "additionalProperties": value,
    })
}

fn scene() -> Value {
    let mut schema = object(
        "A planar mechanism at one instant, the motion that drives it, and what is asked.",
        &[],
        json!({
            "$schema": { "type": "string", "description": "Address of this schema, for editors." },
            "title": {
                "description": "Text, or texts by language tag.",
                "oneOf": [
                    { "type": "string" },
                    {
                        "type": "object", "additionalProperties": { "type": "string" },
                        "propertyNames": { "pattern": "^[A-Za-z0-9]{1,8}(-[A-Za-z0-9]{1,8})*$" },
                    },
                ],
                "examples": ["Problem 3-1", { "en": "Problem 3-1", "ar": "مسألة 3-1" }],
            },
            "units": reference("units"),
            "fixed": by_point("Points of the frame (link 1), exact.", &reference("place")),
            "placed": by_point(
                "Moving points at this instant, as exact as their digits or within a stated room; link dimensions not given elsewhere follow from them.",
                &json!({ "oneOf": [reference("place"), reference("placeWithin")] }),
            ),
            "where": by_point(
                "Moving points at this instant by what a figure states: two loci for each, from points that stand already; link dimensions not given elsewhere follow from them.",
                &json!({
                    "oneOf": [
                        { "type": "array", "items": reference("locus"), "minItems": 1, "maxItems": 2 },
                        reference("locus"),
                    ],
                    "examples": [
                        [{ "from": "O3", "distance": 12.5 }, { "from": "O3", "direction": 60 }],
                        [{ "from": "A", "square_to": ["O2", "A"] }, { "on": { "link": 1, "through": [0, 37] } }],
                    ],
                }),
            ),
            "near": by_point(
                "Rough places of moving points: they choose the assembly and fix nothing else.",
                &reference("place"),
            ),
            "links": {
                "type": "object", "description": "The moving links by number, from 2; link 1 is the frame.",
                "propertyNames": { "pattern": "^([2-9]|[1-9][0-9]+)$" }, "additionalProperties": reference("link"),
            },
            "slides": { "type": "array", "description": "Sliding pairs.", "items": reference("slide") },
            "rolls": { "type": "array", "description": "Rolling pairs and gear meshes.", "items": reference("roll") },
            "input": described("input", "What drives the mechanism."),
            "inputs": {
                "type": "array", "items": reference("input"),
                "description": "What drives the mechanism, one per degree of freedom.",
            },
            "find": {
                "type": "array", "items": reference("find"),
                "description": "Asked quantities; without it, all velocities, accelerations, ω and α.",
            },
            "pins": by_point("Journals of pins, for rubbing speeds, and who holds a pin of several links.", &reference("pin")),
            "gravity": reference("gravity"),
            "masses": {
                "type": "object", "description": "Masses and moments of inertia, by number of the link or block.",
                "propertyNames": { "pattern": "^([2-9]|[1-9][0-9]+)$" }, "additionalProperties": reference("mass"),
            },
            "loads": { "type": "array", "description": "Forces and torques on links, given or sought.", "items": reference("load") },
            "springs": { "type": "array", "description": "Springs.", "items": reference("spring") },
            "spin": reference("spin"),
            "cycle": reference("cycle"),
            "published": {
                "type": "object", "propertyNames": reference("quantity"), "additionalProperties": reference("published"),
                "description": "What somebody printed, by name of the quantity. Never used in the solution.",
            },
            "errata": {
                "type": "array", "items": reference("quantity"), "uniqueItems": true,
                "description": "Names in `published` known to be wrong: the check must find exactly these.",
            },
            "expect": {
                "enum": ["cannot-assemble", "indeterminate", "ambiguous", "locked", "no-equilibrium"],
                "description": "The refusal that this scene must get.",
            },
            "sheet": reference("sheet"),
            "vary": {
                "type": "object", "additionalProperties": reference("range"),
                "propertyNames": { "pattern": "^(fixed|placed|where|links|slides|rolls|inputs?|pins)[.\\[]" },
                "description": "What the variants of an exam may change: the path of a given number, and its range.",
                "examples": [{
                    "links.2.length": { "from": 12, "to": 18, "step": 0.5 },
                    "fixed.O4[0]": { "from": 40, "to": 50, "step": 1 },
                    "slides[0].on.angle": { "from": -10, "to": 10, "step": 5 },
                }],
            },
        }),
    );
    schema["$schema"] = json!("https://json-schema.org/draft/2020-12/schema");
    schema["title"] = json!("linkgram scene");
    schema["not"] = json!({ "required": ["input", "inputs"] });
    schema
}

fn definitions() -> serde_json::Map<String, Value> {
    let mut all = serde_json::Map::new();
    let parts = [values(), links(), pairs(), motion(), forces(), cycle(), results(), sheet()];
    for part in parts {
        if let Value::Object(part) = part {
            all.extend(part);
        }
    }
    all
}

/// Points, numbers of links, and numbers with units.
fn values() -> Value {
    let unit = names().collect::<Vec<_>>().join("|");
    let number = r"^\s*[+-]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?";
    let factor = format!(r"({unit})\s*(²|\^?\s*[1-9])?");
    let quantity = |description: &str, examples: Value| {
        json!({
            "description": format!("{description} A bare number is in the scene's unit; text carries its own."),
            "oneOf": [
                { "type": "number" },
                { "type": "string", "pattern": format!(r"{number}\s*({factor}(\s*[*/]\s*{factor})*)?(\s*c?cw)?\s*$") },
            ],
            "examples": examples,
        })
    };
    json!({
        "point": {
            "type": "string", "maxLength": 64, "pattern": "^[^!-@\\[-`{-~\\s][^\\s/,()\"`@]*$",
            "description": "Name of a point: a letter, then no blank, slash, comma, quote or parenthesis.",
            "examples": ["A", "O2"],
        },
        "linkNumber": { "type": "integer", "minimum": 1, "description": "Number of a link; 1 is the frame." },
        "movingLink": { "type": "integer", "minimum": 2, "description": "Number of a moving link." },
        "length": quantity("A length.", json!([15, "6 in", "25 mm"])),
        "angle": quantity("An angle, counter-clockwise positive; any number of turns.", json!([30, "30 deg cw", "0.25 rev"])),
        "velocity": quantity("A velocity.", json!(["24.4 m/s", "6 m/s ccw"])),
        "acceleration": quantity("An acceleration.", json!(["15 m/s^2"])),
        "omega": quantity("An angular velocity, counter-clockwise positive; bare in rad.", json!(["10 rad/s cw", "75 rpm cw"])),
        "alpha": quantity("An angular acceleration, counter-clockwise positive; bare in rad.", json!(["15 rad/s^2 ccw"])),
        "place": {
            "type": "array", "items": reference("length"), "minItems": 2, "maxItems": 2,
            "description": "Coordinates [x, y], x to the right and y up.", "examples": [[0, 37]],
        },
        "placeWithin": object("A place that was read off a figure, with the radius of its room.", &["at", "within"], json!({
            "at": described("place", "The place as it was read."),
            "within": described("length", "How far the true place may be away; it enters every bound."),
        })),
        "locus": locus(),
        "units": object("Units of bare numbers; m, deg and s where nothing is said.", &[], json!({
            "length": { "enum": ["nm", "um", "mm", "cm", "m", "km", "in", "ft"], "default": "m", "description": "Unit of lengths." },
            "angle": { "enum": ["deg", "rad", "rev"], "default": "deg", "description": "Unit of angles; ω and α are in rad whatever it is." },
            "time": { "enum": ["ms", "s", "min"], "default": "s", "description": "Unit of time." },
            "force": { "type": "string", "default": "N", "description": "Unit of forces." },
            "mass": { "type": "string", "default": "kg", "description": "Unit of masses." },
            "torque": { "type": "string", "default": "N*m", "description": "Unit of torques and works." },
            "inertia": { "type": "string", "default": "kg*m^2", "description": "Unit of moments of inertia." },
            "stiffness": { "type": "string", "default": "N/m", "description": "Unit of the stiffness of a spring." },
            "pressure": { "type": "string", "default": "Pa", "description": "Unit of pressures." },
            "power": { "type": "string", "default": "W", "description": "Unit of powers." },
        })),
    })
}

fn locus() -> Value {
    let two = |description: &str| {
        json!({
            "type": "array", "items": reference("point"), "minItems": 2, "maxItems": 2, "description": description,
        })
    };
    let mut locus = object(
        "Where a point lies: a circle (`from`, `distance`), a ray (`from`, `direction`; both together are the point itself), a line (`from`, `square_to`), the circle from which a segment is seen at an angle (`sees`, `at`), or a guide (`on`).",
        &[],
        json!({
            "from": described("point", "The centre of the circle, the beginning of the ray, or a point of the line."),
            "distance": described("length", "Distance from that point."),
            "direction": described("angle", "Direction of the ray from +x."),
            "square_to": two("The line is square to that through these two points."),
            "sees": two("The ends of the segment."),
            "at": described("angle", "The angle at which it is seen: from the direction to its first end to that to its second, counter-clockwise; of a right angle the sense does not matter."),
            "on": described("guide", "A line or an arc, written as in `slides`; without `link` of the frame, and by any points that stand."),
        }),
    );
    locus["oneOf"] =
        json!([{ "required": ["from"] }, { "required": ["sees", "at"] }, { "required": ["on"] }]);
    locus
}

fn links() -> Value {
    let one_of = |keys: [&str; 5]| -> Value {
        let pairs = (0..5).flat_map(|i| (i + 1..5).map(move |j| (i, j)));
        pairs.map(|(i, j)| json!({ "required": [keys[i], keys[j]] })).collect()
    };
    let mut link = object(
        "A rigid link. Its dimensions are one of `length`, `line`, `sides`, `shape` and `arms`, or nothing where all its points are placed or where it has one joint.",
        &["joins"],
        json!({
            "joins": {
                "type": "array", "items": reference("point"), "minItems": 1, "uniqueItems": true,
                "description": "Joints and points of interest. A point that stands in several links is a pin between them.",
            },
            "length": described("length", "Distance of its two joints."),
            "line": {
                "type": "array", "items": reference("length"), "minItems": 2,
                "description": "Positions along a straight link, in the order of `joins`.", "examples": [[0, 30, -30]],
            },
            "sides": {
                "type": "array", "items": reference("length"), "minItems": 3, "maxItems": 3,
                "description": "Three joints: lengths 1–2, 2–3 and 3–1.",
            },
            "turn": { "enum": ["ccw", "cw"], "default": "ccw", "description": "Turning sense of the triangle of `sides`." },
            "shape": by_point("Own coordinates of every point of `joins`.", &reference("place")),
            "arms": {
                "type": "array", "minItems": 3, "maxItems": 3, "items": false,
                "prefixItems": [reference("length"), reference("length"), reference("angle")],
                "description": "Three joints: lengths 1–2 and 1–3, and the angle from the first arm to the second, counter-clockwise.",
            },
        }),
    );
    link["not"] = json!({ "anyOf": one_of(["length", "line", "sides", "shape", "arms"]) });
    link["dependentRequired"] = json!({ "turn": ["sides"] });
    json!({ "link": link })
}

fn pairs() -> Value {
    let two = |items: Value, description: &str| json!({ "type": "array", "items": items, "minItems": 2, "maxItems": 2, "description": description });
    let point_or_place = |description: &str| json!({ "oneOf": [reference("point"), reference("place")], "description": description });
    let teeth = json!({ "type": "integer", "minimum": 1, "maximum": 1_000_000 });
    let guide = object(
        "A guide: a straight line, or an arc with `centre` and `radius`. Coordinates and angles are its link's own.",
        &[],
        json!({
            "link": described("linkNumber", "The link that carries the guide."),
            "through": point_or_place("A point of the link, or own coordinates, through which the line goes."),
            "angle": described("angle", "Direction of the line, from the link's own x-axis; default 0."),
            "toward": described("point", "Another point of the link, toward which the line goes."),
            "turned": described("angle", "Added to the direction, counter-clockwise."),
            "offset": described("length", "Parallel shift to the left of the direction."),
            "centre": point_or_place("Centre of an arc: a point of the link, or own coordinates."),
            "radius": described("length", "Radius of an arc."),
        }),
    );
    let mut slide = object(
        "A sliding pair: a `pin` (perhaps in a numbered `block`) or a `link` that slides without turning, `on` a guide.",
        &["on"],
        json!({
            "pin": described("point", "The pin that slides."),
            "block": described("movingLink", "Number of the block in which the pin turns."),
            "link": described("movingLink", "The link that slides; its first joint is on the guide."),
            "turned": described("angle", "Angle from the guide to the sliding link's own x-axis."),
            "on": described("guide", "The guide."),
            "f": roughness(),
            "drag": {
                "oneOf": [{ "type": "number" }, { "type": "string" }],
                "description": "A constant force against sliding.", "examples": ["28 N"],
            },
        }),
    );
    slide["oneOf"] = json!([{ "required": ["pin"] }, { "required": ["link"] }]);
    slide["dependentRequired"] = json!({ "block": ["pin"], "turned": ["link"] });
    let mut roll = object(
        "A rolling pair or gear mesh: two circles (`centres`, `radii`), or a wheel (`centre`, `radius`) on a `line`.",
        &["links"],
        json!({
            "links": two(reference("linkNumber"), "The two bodies."),
            "centres": two(reference("point"), "The centres of the two circles, a point of each body."),
            "radii": two(reference("length"), "The radii of the two circles."),
            "teeth": {
                "oneOf": [two(teeth.clone(), "Numbers of teeth of two wheels."), teeth],
                "description": "With `module`, stands for the radii.",
            },
            "module": described("length", "Pitch diameter per tooth."),
            "internal": { "type": "boolean", "default": false, "description": "One circle lies inside the other." },
            "line": described("guide", "The straight line of a rack or plane; its `link` may be left out."),
            "centre": described("point", "The centre of the wheel on a `line`."),
            "radius": described("length", "The radius of the wheel on a `line`."),
            "pressure": described("angle", "Angle of pressure of the teeth, for forces: 20 degrees with `teeth`, otherwise the wheels are smooth and the force is along the common tangent."),
        }),
    );
    roll["oneOf"] = json!([{ "required": ["centres"] }, { "required": ["line", "centre"] }]);
    roll["dependentRequired"] = json!({ "teeth": ["module"], "module": ["teeth"] });
    json!({ "guide": guide, "slide": slide, "roll": roll })
}

fn motion() -> Value {
    let speed = json!({
        "type": "object", "minProperties": 1, "maxProperties": 1,
        "propertyNames": reference("point"), "additionalProperties": reference("velocity"),
        "description": "Speed of one point about the link's first joint, counter-clockwise positive.",
        "examples": [{ "A": "6 m/s ccw" }],
    });
    let mut input = object(
        "A driven `link` or a driven `slide`. A missing rate is 0.",
        &[],
        json!({
            "link": described("movingLink", "The driven link."),
            "angle": described("angle", "Angle of the line from its first to its second joint, from +x; left out where the link is placed."),
            "omega": described("omega", "Its angular velocity."),
            "alpha": described("alpha", "Its angular acceleration."),
            "speed": speed,
            "slide": {
                "oneOf": [reference("point"), reference("movingLink")],
                "description": "The driven sliding pair: its pin, or its block's or link's number.",
            },
            "at": described("length", "Distance along the guide from `through` (after `offset`); left out where the rider is placed."),
            "velocity": described("velocity", "Velocity along the guide."),
            "acceleration": described("acceleration", "Acceleration along the guide."),
        }),
    );
    // Of a turning-moment diagram without links only `omega` is given.
    let neither = json!({ "required": ["omega"], "not": { "anyOf": [{ "required": ["link"] }, { "required": ["slide"] }] } });
    input["oneOf"] = json!([{ "required": ["link"] }, { "required": ["slide"] }, neither]);
    json!({ "input": input })
}

/// What acts on the links besides their pairs.
fn forces() -> Value {
    let text_or_number = |description: &str, examples: Value| {
        json!({
            "oneOf": [{ "type": "number" }, { "type": "string" }],
            "description": format!("{description} A bare number is in the scene's unit; text carries its own."),
            "examples": examples,
        })
    };
    let spot = |description: &str| json!({ "oneOf": [reference("point"), reference("place")], "description": description });
    let sought = |description: &str, examples: Value| {
        text_or_number(&format!("{description} \"?\" seeks it."), examples)
    };
    let or_curve = |mut size: Value| {
        size["oneOf"] = json!([{ "type": "number" }, { "type": "string" }, reference("curve")]);
        size
    };
    let gravity = object(
        "The field of gravity; weights act where it stands, and {} is 9.81 m/s² downwards.",
        &[],
        json!({
            "g": described("acceleration", "Its size; 9.81 m/s² where it is left out."),
            "direction": described("angle", "Its direction from +x; -90° where it is left out."),
            "acts": { "type": "boolean", "default": true, "description": "Whether weights act; otherwise g only makes weights masses." },
        }),
    );
    let mass = object(
        "The mass of a link.",
        &[],
        json!({
            "mass": text_or_number("Its mass.", json!([2.5, "3 kg"])),
            "weight": text_or_number("Its weight, mass times g.", json!(["20 N", "4 lbf"])),
            "at": spot("Its mass centre: a point of the link, or own coordinates; left out for a link of one joint."),
            "inertia": text_or_number("Its moment of inertia about the mass centre.", json!([0.02, "33 kg*m^2"])),
            "about": spot("Another point about which `inertia` is given."),
            "gyration": described("length", "Radius of gyration about the mass centre, in the place of `inertia`."),
        }),
    );
    let pointing = object(
        "Where a force points.",
        &[],
        json!({
            "from": described("point", "From this point"),
            "to": described("point", "to this one,"),
            "turned": described("angle", "turned counter-clockwise by this."),
            "link": described("linkNumber", "In the own coordinates of this link"),
            "angle": described("angle", "at this angle from its x-axis."),
        }),
    );
    let load = object(
        "A force or a torque on a link.",
        &["on"],
        json!({
            "name": { "type": "string", "description": "Its name.", "examples": ["P"] },
            "on": described("movingLink", "The loaded link or block."),
            "at": spot("Where on it; left out for a block: its pin."),
            "force": {
                "oneOf": [
                    { "type": "number" }, { "type": "string" },
                    { "type": "array", "items": { "oneOf": [{ "type": "number" }, { "type": "string" }] }, "minItems": 2, "maxItems": 2 },
                    reference("curve"),
                ],
                "description": "Size of a force, or its components [x, y]; \"?\" seeks it.", "examples": ["400 N", "?", [0, -20]],
            },
            "direction": {
                "oneOf": [reference("angle"), reference("pointing"), { "enum": ["against", "with"] }],
                "description": "Where a force points, 0 where it is left out; against or with the motion.",
            },
            "in": described("linkNumber", "In whose own coordinates the components are; the world's where it is left out."),
            "torque": or_curve(sought("Size of a torque, counter-clockwise positive.", json!(["12 N*m cw", "?"]))),
            "pressure": or_curve(text_or_number("A pressure on `area` or `bore`.", json!(["28 bar"]))),
            "area": text_or_number("The area; a bare number is in the square of the scene's unit of length.", json!(["80 cm^2"])),
            "bore": described("length", "Diameter of the piston."),
            "rod": described("length", "Diameter of its rod."),
        }),
    );
    let end = object(
        "A place on a link.",
        &["link", "at"],
        json!({
            "link": described("linkNumber", "The link."),
            "at": spot("A point of it, or own coordinates."),
        }),
    );
    let spring = object(
        "A spring.",
        &[],
        json!({
            "name": { "type": "string", "description": "Its name.", "examples": ["S"] },
            "between": {
                "type": "array", "items": reference("springEnd"), "minItems": 2, "maxItems": 2,
                "description": "The two places between which it pulls.",
            },
            "links": {
                "type": "array", "items": reference("linkNumber"), "minItems": 2, "maxItems": 2,
                "description": "The two links between which a torsion spring acts.",
            },
            "stiffness": sought("Force for a unit of length; of a torsion spring torque for a radian.", json!(["2 kN/m", "3 N*m/rad"])),
            "free": {
                "oneOf": [reference("length"), reference("angle")],
                "description": "Its length without load; of a torsion spring the angle of the second link against the first.",
            },
            "force": sought("Its pull now; of a torsion spring its torque on the second link.", json!(["40 N", "?"])),
        }),
    );
    json!({
        "gravity": gravity, "mass": mass, "load": load, "pointing": pointing, "springEnd": end, "spring": spring,
    })
}

/// How rough a pair is.
fn roughness() -> Value {
    json!({
        "oneOf": [{ "type": "number", "minimum": 0 }, { "type": "string", "pattern": "^\\s*[0-9.]" }],
        "description": "Coefficient of friction, or its angle.", "examples": [0.1, "6 deg"],
    })
}

/// The turning-moment diagram.
fn cycle() -> Value {
    let number = |description: &str, examples: Value| {
        json!({
            "oneOf": [{ "type": "number" }, { "type": "string" }],
            "description": description, "examples": examples,
        })
    };
    let pairs = |description: &str, example: Value| {
        let pair = json!({
            "type": "array", "minItems": 2, "maxItems": 2,
            "items": { "oneOf": [{ "type": "number" }, { "type": "string" }] },
        });
        json!({ "type": "array", "items": pair, "description": description, "examples": [example] })
    };
    let cycle = object(
        "The turning-moment diagram. Of `torque` and `load` one may be left out: it is constant, the mean.",
        &[],
        json!({
            "torque": { "oneOf": [reference("course"), reference("areas")], "description": "The driving torque, at the first input." },
            "load": described("course", "The resisting torque, at the first input."),
            "period": number("After which angle everything comes again; one turn where it is left out.", json!([720])),
            "copies": reference("copies"),
            "rotating": { "type": "array", "items": reference("rotating"), "description": "Known inertias that turn with the input." },
            "fluctuation": { "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 2, "description": "Wanted (ω_max − ω_min)/ω, 0.02 for ±1 %; a flywheel is sought." },
        }),
    );
    let course = object(
        "A torque over the angle of the input.",
        &[],
        json!({
            "of": described("movingLink", "What the mechanism gives, or as a load needs, at its driven link."),
            "table": pairs("Angle and size, straight between; a leap where an angle stands twice.", json!([[0, 0], [60, 800], [180, 0]])),
            "harmonics": reference("harmonics"),
        }),
    );
    let curve = object(
        "A size over the angle of the first input.",
        &[],
        json!({
            "table": pairs("Angle and size, straight between; a leap where an angle stands twice.", json!([[0, "28 bar"], [180, "4 bar"]])),
            "harmonics": reference("harmonics"),
            "period": described("angle", "After which angle it comes again; where it is left out, that of the cycle, or one turn."),
        }),
    );
    let harmonics = object(
        "A constant with sines and cosines.",
        &[],
        json!({
            "constant": number("What is there without waves.", json!([2500])),
            "sin": pairs("Order (waves in a turn) and size.", json!([[2, 675]])),
            "cos": pairs("Order (waves in a turn) and size.", json!([[1, 270]])),
        }),
    );
    let areas = object(
        "Areas between the driving torque and its mean, off the paper.",
        &["areas", "scale"],
        json!({
            "areas": { "type": "array", "items": { "type": "number" }, "description": "From the first crossing on, above the mean positive." },
            "scale": reference("areaScale"),
            "total": { "type": "number", "description": "The whole area under the curve: for the mean and what hangs on it." },
        }),
    );
    let scale = object(
        "What a unit of length of the paper stands for.",
        &["torque", "angle"],
        json!({
            "torque": number("A torque.", json!(["150 N*m"])),
            "angle": number("An angle.", json!(["12 deg"])),
        }),
    );
    let copies = object(
        "The same curves again, as of several cylinders.",
        &["number", "shift"],
        json!({
            "number": { "type": "integer", "minimum": 1, "description": "How many curves there are in all." },
            "shift": number("By which angle each follows the one before.", json!([120])),
        }),
    );
    let rotating = object(
        "An inertia that turns with the input: `inertia`, or `mass` or `weight` with `gyration`.",
        &[],
        json!({
            "inertia": number("Moment of inertia.", json!([0.9])),
            "mass": number("Mass.", json!([20])),
            "weight": number("Weight.", json!(["70 N"])),
            "gyration": described("length", "Radius of gyration."),
            "ratio": { "type": "number", "default": 1, "description": "Its speed over that of the input." },
        }),
    );
    let axis = object(
        "The axis about which the plane turns.",
        &["through", "angle"],
        json!({
            "through": described("place", "A point of it, in the world."),
            "angle": described("angle", "Its direction from +x."),
        }),
    );
    let spin = object(
        "A governor: the whole plane turns about an axis in it.",
        &["axis", "omega"],
        json!({
            "axis": reference("axis"),
            "omega": { "oneOf": [{ "type": "number" }, { "type": "string" }], "description": "How fast it turns; \"?\" seeks the speed of equilibrium.", "examples": ["300 rpm", "?"] },
            "balls": { "type": "integer", "minimum": 1, "default": 1, "description": "Of so many equal halves one is drawn." },
            "sleeve": described("movingLink", "The link that all halves share."),
        }),
    );
    json!({
        "spin": spin, "axis": axis,
        "cycle": cycle, "course": course, "curve": curve, "harmonics": harmonics, "areas": areas, "areaScale": scale,
        "copies": copies, "rotating": rotating,
    })
}

fn results() -> Value {
    let mut pin = object(
        "A pin's journal.",
        &[],
        json!({
            "radius": described("length", "Radius of the journal."),
            "diameter": described("length", "Diameter of the journal."),
            "carrier": described("linkNumber", "The link that holds a pin of several links."),
            "f": roughness(),
            "circle": described("length", "Radius of the friction circle."),
        }),
    );
    pin["anyOf"] = json!([
        { "required": ["radius"] }, { "required": ["diameter"] }, { "required": ["carrier"] }, { "required": ["circle"] },
    ]);
    pin["not"] =
        json!({ "anyOf": [{ "required": ["radius", "diameter"] }, { "required": ["f", "circle"] }] });
    let number = json!({ "oneOf": [{ "type": "number" }, { "type": "string" }] });
    let published = object(
        "A printed value with an allowed deviation.",
        &["value"],
        json!({
            "value": { "oneOf": number["oneOf"], "description": "The printed number.", "examples": ["5.66 rad/s ccw"] },
            "within": {
                "oneOf": [
                    { "type": "number", "exclusiveMinimum": 0, "maximum": 1 },
                    { "type": "string", "pattern": "^\\s*[0-9.]+([eE][+-]?[0-9]+)?\\s*%?\\s*$" },
                ],
                "description": "Allowed relative deviation.", "examples": ["10 %"],
            },
            "why": { "type": "string", "description": "Why it is allowed.", "examples": ["1 mm on the printed drawing"] },
        }),
    );
    let examples: Vec<&str> = names_of_quantities().map(|(form, _)| form).collect();
    let meanings: Vec<String> =
        names_of_quantities().map(|(form, meaning)| format!("{form}: {meaning}")).collect();
    json!({
        "quantity": {
            "type": "string",
            "pattern": format!(r"^\s*(FS|spin|Tmean|E|power|Emax|Emin|Ef|Ke|Ks|If|I|({})\s*\(.+\))(\.static|\.inertia)?\s*$", heads().join("|")),
            "description": format!("Name of a quantity; `/` reads \"relative to\", `@` \"on\". {}.", meanings.join("; ")),
            "examples": examples,
        },
        "find": {
            "oneOf": [reference("quantity"), reference("asked")],
            "description": "An asked quantity.",
        },
        "asked": object("An asked quantity with its output unit.", &["name"], json!({
            "name": described("quantity", "The quantity."),
            "unit": { "type": "string", "description": "Output unit.", "examples": ["mm/s", "rpm"] },
            "method": {
                "enum": Method::names().collect::<Vec<_>>(),
                "description": "By which construction it is found: the polygons (default), instant centres (direct), one of their three graphical transfers for a v(B) or omega(3), or Klein's construction of a slider-crank; an inertia force by two masses, an effort by Zhukovsky's lever, a force of a pair by three forces that meet or by its components."
            },
            "first": { "type": "string", "description": "Of `two-masses`: the point of the link at which the first mass stands." },
            "second": { "type": "string", "description": "Of `two-masses`: the point at which the second mass stands, where a couple is to correct their moment of inertia." },
        })),
        "pin": pin,
        "published": {
            "oneOf": [{ "type": "number" }, { "type": "string" }, reference("publishedValue")],
            "description": "What was printed. Vectors, and scalars without cw or ccw, are compared in magnitude.",
        },
        "publishedValue": published,
    })
}

fn sheet() -> Value {
    let length = json!({ "type": "string", "description": "Scale of the skeleton.", "examples": ["1:10", "10 cm per cm"] });
    let velocity = json!({ "type": "string", "description": "Scale of the velocity polygon.", "examples": ["50 cm/s per cm"] });
    let acceleration = json!({
        "type": "string", "description": "Scale of the acceleration polygon.", "examples": ["500 cm/s^2 per cm"],
    });
    let force = json!({ "type": "string", "description": "Scale of the force polygons.", "examples": ["1000 N per cm"] });
    json!({
        "scales": object("Scales by diagram.", &[], json!({
            "length": length, "velocity": velocity, "acceleration": acceleration, "force": force,
        })),
        "range": object("Numbers in equal steps, in the unit of the number that varies.", &["from", "to", "step"], json!({
            "from": { "type": "number", "description": "The first one." },
            "to": { "type": "number", "description": "The last one, a whole number of steps away." },
            "step": { "type": "number", "exclusiveMinimum": 0, "description": "By how much neighbours differ." },
        })),
        "live": object("How the live page opens; whoever reads it may change all of it.", &[], json!({
            "play_seconds": {
                "type": "number", "minimum": PLAY_SECONDS[0], "maximum": PLAY_SECONDS[1], "default": 6,
                "description": "Seconds in which the whole course plays.",
            },
            "traces": {
                "type": "array", "items": { "type": "string" }, "description": "Points whose paths are drawn.",
                "examples": [["B"]],
            },
            "diagrams": {
                "type": "array", "items": { "type": "string" },
                "description": "Quantities, asked for, whose diagrams over the input are drawn.",
                "examples": [["omega(4)"]],
            },
            "scale": {
                "enum": LIVE_SCALES,
                "description": "Polygons keep one scale over the course, or are fitted to each position; where nothing is said, the latter where they would be too small.",
            },
            "panels": {
                "type": "array", "items": { "enum": LIVE_PANELS },
                "description": "The panels that are open, of those that the question has; all where nothing is said.",
                "examples": [["skeleton", "velocity"]],
            },
        })),
        "sheet": object("How to draw.", &[], json!({
            "paper": {
                "type": "string", "pattern": format!("^\\s*({})(\\s+(portrait|landscape))?\\s*$", PAPERS.join("|")),
                "default": "A4", "description": "Paper size.", "examples": ["A4", "A3 landscape"],
            },
            "language": { "enum": LANGUAGES, "description": "Language of the sheet." },
            "theme": { "enum": THEMES, "default": "mono", "description": "Colours of the sheet." },
            "marks": {
                "type": "object", "additionalProperties": { "type": "number", "minimum": 0, "maximum": 1000 },
                "description": "Marks for answers in an exam, by the name of the quantity; 1 where nothing is said.",
                "examples": [{ "v(B)": 2, "alpha(3)": 3 }],
            },
            "symbols": { "enum": ["alpha", "epsilon"], "description": "Letter for angular acceleration." },
            "notation": {
                "enum": NOTATIONS, "default": "standard",
                "description": "How vectors are written: the usual way, or as in the textbook of this author.",
            },
            "decimal": { "enum": ["point", "comma"], "default": "point", "description": "Decimal sign." },
            "positions": {
                "type": "array", "items": { "anyOf": [reference("angle"), reference("length")] }, "maxItems": POSITIONS,
                "description": "Other positions of the mechanism, drawn dashed on the skeleton: places of the first input, angles or for a slide lengths.",
                "examples": [[60, "90 deg"]],
            },
            "other_assembly": {
                "type": "boolean", "default": false,
                "description": "Draw the other assembly of the mechanism dashed on the skeleton.",
            },
            "live": described("live", "How the live page opens."),
            "scales": described("scales", "Scales; chosen where they are left out."),
            "length": length, "velocity": velocity, "acceleration": acceleration,
            "figures": {
                "type": "array", "items": { "type": "string" }, "description": "Figures wanted; all where it is left out.",
                "examples": [["skeleton", "velocity"], ["klein", "centrodes(1,3)"]],
            },
        })),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::keys;

    /// The reader's tables and the schema name the same keys, and every key is described.
    #[test]
    fn same_keys_as_the_reader() {
        let schema = schema();
        let tables: [(&str, &[&str]); 32] = [
            ("", keys::SCENE),
            ("/$defs/units", keys::UNITS),
            ("/$defs/placeWithin", keys::PLACED),
            ("/$defs/locus", keys::LOCUS),
            ("/$defs/link", keys::LINK),
            ("/$defs/slide", keys::SLIDE),
            ("/$defs/guide", keys::GUIDE),
            ("/$defs/roll", keys::ROLL),
            ("/$defs/input", keys::INPUT),
            ("/$defs/asked", keys::FIND),
            ("/$defs/pin", keys::PIN),
            ("/$defs/publishedValue", keys::PUBLISHED),
            ("/$defs/sheet", keys::SHEET),
            ("/$defs/live", keys::LIVE),
            ("/$defs/scales", keys::SCALES),
            ("/$defs/range", keys::RANGE),
            ("/$defs/gravity", keys::GRAVITY),
            ("/$defs/mass", keys::MASS),
            ("/$defs/load", keys::LOAD),
            ("/$defs/pointing", keys::POINTING),
            ("/$defs/spring", keys::SPRING),
            ("/$defs/springEnd", keys::SPRING_END),
            ("/$defs/spin", keys::SPIN),
            ("/$defs/axis", keys::AXIS),
            ("/$defs/cycle", keys::CYCLE),
            ("/$defs/course", keys::COURSE),
            ("/$defs/curve", keys::CURVE),
            ("/$defs/harmonics", keys::HARMONICS),
            ("/$defs/areas", keys::AREAS),
            ("/$defs/areaScale", keys::AREA_SCALE),
            ("/$defs/copies", keys::COPIES),
            ("/$defs/rotating", keys::ROTATING),
        ];
        for (place, keys) in tables {
            let object = schema.pointer(place).unwrap();
            assert_eq!(object["additionalProperties"], json!(false), "{place}");
            let mut listed: Vec<&str> =
                object["properties"].as_object().unwrap().keys().map(String::as_str).collect();
            let mut known = keys.to_vec();
            listed.sort_unstable();
            known.sort_unstable();
            assert_eq!(listed, known, "{place}");
        }
        let objects = schema["$defs"].as_object().unwrap().values();
        let closed = objects.filter(|d| d["additionalProperties"] == json!(false)).count();
        assert_eq!(closed, tables.len() - 1, "an object of the schema has no table in the reader");
    }

    /// Every `$ref` leads somewhere and every definition is used.
    #[test]
    fn references_hold() {
        fn collect(value: &Value, into: &mut Vec<String>) {
            match value {
                Value::Object(map) => {
                    if let Some(Value::String(target)) = map.get("$ref") {
                        into.push(target.clone());
                    }
                    map.values().for_each(|v| collect(v, into));
                }
                Value::Array(items) => items.iter().for_each(|v| collect(v, into)),
                _ => {}
            }
        }
        let schema = schema();
        let mut targets = Vec::new();
        collect(&schema, &mut targets);
        for target in &targets {
            assert!(schema.pointer(target.trim_start_matches('#')).is_some(), "{target}");
        }
        for name in schema["$defs"].as_object().unwrap().keys() {
            assert!(targets.iter().any(|t| *t == format!("#/$defs/{name}")), "{name} is never used");
        }
    }
}
