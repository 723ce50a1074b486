//! Scenes, answers and drawings that somebody might hand in by mistake or malice: those of the project with mutations
//! that know what a scene is made of.

use serde_json::{Map, Value, json};

use super::dice::Dice;

/// Numbers that nobody means, or that somebody means wrongly.
const NUMBERS: &[f64] = &[
    0.0, -0.0, 1.0, -1.0, 0.1, 2.0, 3.0, 45.0, 90.0, -90.0, 180.0, 360.0, 1e-12, 1e-9, 1e-3, 1e3, 1e6, 1e9,
    1e15, 1e30, 1e59, 1e-59, 1e61, 1e300, 1e-300, 5e-324, 1.797e308, -1e308,
];
const FACTORS: &[f64] =
    &[-1.0, 0.0, 1e-6, 1e-3, 0.1, 0.5, 0.9, 0.99, 1.0 + 1e-12, 1.0 + 1e-6, 1.1, 2.0, 10.0, 1e3, 1e6, 1e12];
const UNITS: &[&str] = &[
    "m", "mm", "cm", "km", "in", "ft", "nm", "um", "deg", "rad", "rev", "s", "ms", "min", "rpm", "rad/s",
    "deg/s", "rad/s^2", "m/s", "cm/s", "mm/s^2", "parsec", "%", "", "rad/s cw", "rpm ccw", "s^-1", "m*m",
];
const WORDS: &[&str] = &[
    "",
    " ",
    "A",
    "B",
    "O2",
    "Z9",
    "1",
    "nan",
    "inf",
    "-",
    "cw",
    "ccw",
    "null",
    "\u{0}",
    "\u{202e}",
    "ω(3)",
    "متر",
    "{1:NUMERICAL:=5}",
    "]]>",
    "<svg/>",
    "\u{fffe}",
    "cannot-assemble",
    "indeterminate",
    "ambiguous",
    "A4",
    "1:10",
    "50 cm/s per cm",
    "ar",
    "fa",
    "tlh",
    "centres",
    "link-to-link",
    "direct",
    "line-of-centres",
    "klein",
    "\\",
    "\"",
];
const KEYS: &[&str] = &[
    "title",
    "units",
    "fixed",
    "placed",
    "where",
    "near",
    "links",
    "slides",
    "rolls",
    "input",
    "inputs",
    "find",
    "pins",
    "published",
    "errata",
    "expect",
    "sheet",
    "vary",
    "joins",
    "length",
    "line",
    "sides",
    "turn",
    "shape",
    "arms",
    "pin",
    "block",
    "link",
    "on",
    "through",
    "angle",
    "toward",
    "turned",
    "offset",
    "centre",
    "radius",
    "omega",
    "alpha",
    "speed",
    "slide",
    "at",
    "velocity",
    "acceleration",
    "name",
    "unit",
    "value",
    "within",
    "method",
    "centres",
    "radii",
    "internal",
    "teeth",
    "module",
    "positions",
    "other_assembly",
    "scales",
    "language",
    "paper",
    "figures",
    "2",
    "3",
    "9",
    "",
    "lenght",
];
const QUANTITIES: &[&str] = &[
    "v(P)",
    "v(P/Q)",
    "a(P)",
    "a(P/Q)",
    "an(P/Q)",
    "at(P/Q)",
    "an(P)",
    "at(P)",
    "omega(m)",
    "omega(m/n)",
    "alpha(m)",
    "alpha(m/n)",
    "ratio(m/n)",
    "advantage(m/n)",
    "slip(P/m)",
    "aslip(P/m)",
    "aslipn(P/m)",
    "aslipt(P/m)",
    "coriolis(P/m)",
    "I(m,n)",
    "rub(P)",
    "rub(P,m/n)",
    "rho(P)",
    "x(P)",
    "angle(m)",
    "transmission(m/n)",
];

/// Paths of all values that please.
fn paths(value: &Value, here: &str, wanted: &dyn Fn(&Value) -> bool, into: &mut Vec<String>) {
    if wanted(value) {
        into.push(here.to_owned());
    }
    match value {
        Value::Object(map) => {
            for (key, inner) in map {
                let key = key.replace('~', "~0").replace('/', "~1");
                paths(inner, &format!("{here}/{key}"), wanted, into);
            }
        }
        Value::Array(list) => {
            for (index, inner) in list.iter().enumerate() {
                paths(inner, &format!("{here}/{index}"), wanted, into);
            }
        }
        _ => {}
    }
}

fn one<'v>(dice: &mut Dice, root: &'v mut Value, wanted: &dyn Fn(&Value) -> bool) -> Option<&'v mut Value> {
    let mut all = Vec::new();
    paths(root, "", wanted, &mut all);
    if all.is_empty() {
        return None;
    }
    let path = dice.pick(&all).clone();
    root.pointer_mut(&path)
}

/// A number that is near, far or absurd.
fn bent(dice: &mut Dice, number: f64) -> Value {
    let bent = match dice.below(4) {
        0 if dice.below(3) == 0 => *dice.pick(NUMBERS),
        0 => number + *dice.pick(NUMBERS),
        _ => number * *dice.pick(FACTORS),
    };
    json!(bent)
}

/// Points and links, as a scene names them.
type Names = (Vec<String>, Vec<String>);

/// Everything that is a point, and every link, as the scene names them.
fn names(root: &Value) -> Names {
    let links = root.get("links").and_then(Value::as_object);
    let numbers: Vec<String> =
        links.into_iter().flat_map(|l| l.keys().cloned()).chain(["1".to_owned()]).collect();
    let joined = links.into_iter().flat_map(|l| l.values()).filter_map(|l| l.get("joins")?.as_array());
    let mut points: Vec<String> = joined.flatten().filter_map(|p| p.as_str().map(str::to_owned)).collect();
    points.extend(root.get("fixed").and_then(Value::as_object).into_iter().flat_map(|f| f.keys().cloned()));
    points.sort();
    points.dedup();
    if points.is_empty() {
        points.push("A".to_owned());
    }
    (points, numbers)
}

fn quantity(dice: &mut Dice, (points, links): &Names) -> String {
    let form = *dice.pick(QUANTITIES);
    let mut name = String::new();
    // Only what stands in the parentheses names anything.
    let (head, inside) = form.split_once('(').unwrap();
    name.push_str(head);
    name.push('(');
    for c in inside.chars() {
        match c {
            'P' | 'Q' => name.push_str(dice.pick::<String>(points)),
            'm' | 'n' => name.push_str(dice.pick::<String>(links)),
            c => name.push(c),
        }
    }
    name
}

/// Another name at every place of one.
fn rename(value: &mut Value, old: &str, new: &str) {
    match value {
        Value::String(text) if text == old => *text = new.to_owned(),
        Value::Array(list) => list.iter_mut().for_each(|inner| rename(inner, old, new)),
        Value::Object(map) => {
            let entries: Vec<(String, Value)> = std::mem::take(map).into_iter().collect();
            for (key, mut inner) in entries {
                rename(&mut inner, old, new);
                map.insert(if key == old { new.to_owned() } else { key }, inner);
            }
        }
        _ => {}
    }
}

/// The first kinds of mutations leave words as they are: most of what they make is still a scene.
const GENTLE: usize = 9;
/// All kinds.
const ALL: usize = 16;

/// One mutation; the result is JSON.
fn bend(dice: &mut Dice, root: &mut Value, kinds: usize) {
    match dice.below(kinds) {
        0..=4 => {
            if let Some(number) = one(dice, root, &Value::is_number) {
                *number = bent(dice, number.as_f64().unwrap_or(1.0));
            }
        }
        5 => {
            let known = names(root);
            if let Some(text) = one(dice, root, &Value::is_string) {
                let old = text.as_str().unwrap_or_default().to_owned();
                let (number, rest) = old.split_once(' ').unwrap_or((&old, ""));
                *text = match (number.parse::<f64>(), dice.below(3)) {
                    (Ok(number), 0) => json!(format!("{number} {}", dice.pick(UNITS))),
                    (Ok(number), _) => json!(format!("{} {rest}", bent(dice, number))),
                    (Err(_), 0) => json!(*dice.pick(WORDS)),
                    (Err(_), _) => json!(dice.pick(&known.0)),
                };
            }
        }
        6 => {
            let names = names(root);
            let asked = quantity(dice, &names);
            let find = root.as_object_mut().map(|map| map.entry("find").or_insert_with(|| json!([])));
            if let Some(Value::Array(list)) = find {
                if dice.below(3) == 0 {
                    list.clear();
                }
                list.push(json!(asked));
            }
        }
        7 => {
            // What was said of a place, or where it is, is forgotten.
            let key = *dice.pick(&["near", "placed", "find", "sheet", "published", "units"]);
            root.as_object_mut().and_then(|map| map.remove(key));
        }
        8 => {
            let names = names(root);
            let mut near = Map::new();
            for name in &names.0 {
                if dice.below(2) == 0 {
                    near.insert(name.clone(), json!([bent(dice, 1.0), bent(dice, 1.0)]));
                }
            }
            if let Some(map) = root.as_object_mut() {
                map.insert("near".to_owned(), Value::Object(near));
            }
        }
        9 => {
            let (points, _) = names(root);
            let (old, new) = (dice.pick(&points).clone(), dice.pick(&points).clone());
            let new = if dice.below(3) == 0 { format!("{new}{{1:NM:=1}}") } else { new };
            rename(root, &old, &new);
        }
        10 | 11 => {
            let donor = one(dice, root, &|_| true).cloned();
            if let (Some(place), Some(donor)) = (one(dice, root, &|_| true), donor) {
                *place = donor;
            }
        }
        12 => {
            if let Some(Value::Array(list)) =
                one(dice, root, &|v| v.as_array().is_some_and(|l| !l.is_empty()))
            {
                let index = dice.below(list.len());
                match dice.below(3) {
                    0 => drop(list.remove(index)),
                    1 => list.push(list[index].clone()),
                    _ => list.swap(index, 0),
                }
            }
        }
        13 | 14 => {
            let donor = one(dice, root, &|_| true).cloned().unwrap_or(Value::Null);
            if let Some(Value::Object(map)) = one(dice, root, &Value::is_object) {
                let key = map.keys().nth(dice.below(map.len())).cloned();
                match (dice.below(3), key) {
                    (0, Some(key)) => drop(map.remove(&key)),
                    (1, Some(key)) => {
                        if let Some(inner) = map.remove(&key) {
                            map.insert((*dice.pick(KEYS)).to_owned(), inner);
                        }
                    }
                    _ => drop(map.insert((*dice.pick(KEYS)).to_owned(), donor)),
                }
            }
        }
        _ => {
            if let Some(value) = one(dice, root, &|_| true) {
                *value = match dice.below(5) {
                    0 => json!([]),
                    1 => json!({}),
                    2 => Value::Null,
                    3 => json!(dice.pick(WORDS)),
                    _ => json!(dice.pick(WORDS).repeat(2_000)),
                };
            }
        }
    }
}

/// One mutation of the bytes.
pub(crate) fn bend_text(dice: &mut Dice, text: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    if bytes.is_empty() {
        return "{".to_owned();
    }
    let at = dice.below(bytes.len());
    let end = (at + 1 + dice.below(60)).min(bytes.len());
    match dice.below(6) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..end)),
        2 => {
            let piece = bytes[at..end].to_vec();
            let to = dice.below(bytes.len());
            bytes.splice(to..to, piece);
        }
        3 => bytes[at] = b"0123456789eE-.,:[]{}\"/<>&=; AB\n"[dice.below(31)],
        4 => bytes[at] = u8::try_from(dice.below(256)).unwrap(),
        _ => {
            let deep = dice.below(3_000);
            bytes.splice(
                at..at,
                dice.pick(&["[", "{\"a\":", "\"", "<g>", "&a;", ",", "("]).repeat(deep).bytes(),
            );
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// A scene with one to four mutations.
pub(crate) fn scene(dice: &mut Dice, from: &str) -> String {
    if dice.below(12) == 0 {
        return bend_text(dice, from);
    }
    let mut value: Value = serde_json::from_str(from).unwrap();
    let (kinds, most) = if dice.below(3) == 0 { (ALL, 4) } else { (GENTLE, 2) };
    for _ in 0..=dice.below(most) {
        bend(dice, &mut value, kinds);
    }
    let text = value.to_string();
    if dice.below(20) == 0 { bend_text(dice, &text) } else { text }
}

/// Answers to a scene with these names: values, lengths and points, some of them absurd.
pub(crate) fn answers(dice: &mut Dice, scene: &str) -> String {
    let names = names(&serde_json::from_str(scene).unwrap_or(Value::Null));
    let number = |dice: &mut Dice| {
        let small = 1.0 + dice.below(300) as f64;
        if dice.below(4) == 0 { bent(dice, small) } else { json!(small) }
    };
    let mut text = match dice.below(3) {
        0 => {
            let mut rows = "quantity,value,unit,sense,direction\n".to_owned();
            for _ in 0..dice.below(6) {
                let (name, value, unit) = (quantity(dice, &names), number(dice), *dice.pick(UNITS));
                rows.push_str(&format!(
                    "\"{name}\",{value},{unit},{},\n",
                    dice.pick(&["", "", "cw", "ccw", "up"])
                ));
            }
            rows
        }
        1 => {
            let mut rows = "figure,point,x,y\nvelocity,o,0,0\n".to_owned();
            for _ in 0..dice.below(6) {
                let name = dice.pick(&names.0).to_lowercase();
                rows.push_str(&format!("velocity,{name},{},{}\n", number(dice), number(dice)));
            }
            rows
        }
        _ => {
            let (mut values, mut lengths, mut points) = (Map::new(), Map::new(), Map::new());
            for _ in 0..dice.below(5) {
                values.insert(quantity(dice, &names), number(dice));
                lengths.insert(quantity(dice, &names), number(dice));
                points.insert(dice.pick(&names.0).to_lowercase(), json!([number(dice), number(dice)]));
            }
            points.insert("o".to_owned(), json!([0, 0]));
            let mut all = json!({ "values": values, "points": { "velocity": points } });
            if dice.below(3) == 0 {
                all["lengths"] = Value::Object(lengths);
            }
            if dice.below(4) == 0 {
                bend(dice, &mut all, ALL);
            }
            all.to_string()
        }
    };
    if dice.below(6) == 0 {
        text = bend_text(dice, &text);
    }
    text
}

/// A drawing whose letters name points of the scene.
pub(crate) fn drawing(dice: &mut Dice, scene: &str) -> String {
    let (points, _) = names(&serde_json::from_str(scene).unwrap_or(Value::Null));
    let mut inside = String::new();
    for layer in ["velocity", "acceleration", "skeleton"] {
        inside.push_str(&format!(
            "<g id='{layer}' transform='{}'>",
            dice.pick(&["", "scale(2)", "rotate(90)", "scale(1e200)", "matrix(0 0 0 0 0 0)"])
        ));
        for _ in 0..dice.below(5) {
            let name = dice.pick(&points);
            let name = if layer == "skeleton" { name.clone() } else { name.to_lowercase() };
            let (x, y) = (dice.below(200), dice.below(200));
            let mark = match dice.below(4) {
                0 => format!("<circle cx='{x}' cy='{y}' r='1'/>"),
                1 => format!("<path d='M{x} {y} l1e{} 3 a9 9 0 1 1 4 4z'/>", dice.below(400)),
                2 => format!("<line x1='{x}' y1='{y}' x2='0' y2='0'/>"),
                _ => format!("<polyline points='{x},{y} 3,4'/>"),
            };
            inside.push_str(&format!(
                "{mark}<text x='{x}' y='{y}' font-size='{}'>{name}</text>",
                1 + dice.below(9)
            ));
        }
        inside.push_str("<circle cx='0' cy='0' r='1'/><text>o</text></g>");
    }
    let text = format!("<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 200 200'>{inside}</svg>");
    if dice.below(3) == 0 { bend_text(dice, &text) } else { text }
}
