//! Every example stated once more by the places of its points.
//!
//! The examples' own values are held to recomputed and published ones elsewhere (`tests/cases.rs`); restated, both
//! solvers must give the values that the independent solver gives to the example as it stands.

use std::collections::BTreeMap;
use std::path::Path;

use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene;
use linkgram::sheet::scale;
use linkgram::solve::{solve, solve_analytically};
use serde_json::{Map, Value, json};

use super::mechanism::{Place, angle, direction, length, minus};

/// Files of a folder, those that are to be refused left out.
fn examples() -> Vec<(String, Value)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut all = Vec::new();
    for folder in
        ["examples", "examples/centres", "examples/errata", "examples/pairs", "examples/constructions"]
    {
        for entry in std::fs::read_dir(root.join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|e| e == "json") {
                let text = std::fs::read_to_string(&path).unwrap();
                let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
                all.push((name, serde_json::from_str(&text).unwrap()));
            }
        }
    }
    all.sort_by(|a, b| a.0.cmp(&b.0));
    all
}

fn keys(scene: &Value, key: &str) -> Vec<String> {
    scene.get(key).and_then(Value::as_object).map(|o| o.keys().cloned().collect()).unwrap_or_default()
}

fn list<'a>(scene: &'a mut Value, key: &str) -> Vec<&'a mut Value> {
    scene.get_mut(key).and_then(Value::as_array_mut).map(|a| a.iter_mut().collect()).unwrap_or_default()
}

fn number(value: &Value) -> Option<f64> {
    value.as_f64()
}

/// Where a link's own coordinates are in the world, in the scene's unit.
struct Own {
    origin: Place,
    angle: f64,
}

/// What the independent solver says of these names; SI units.
fn answers(scene: &Value, names: &[String]) -> Option<BTreeMap<String, Answer>> {
    let mut scene = scene.clone();
    scene["find"] = json!(names);
    let read = scene::read(&scene.to_string(), "example.json").unwrap_or_else(|e| panic!("{e}"));
    let state = solve_analytically(&read).ok()?;
    Some(names.iter().cloned().zip(read.mechanism.asked.iter().map(|a| state.answer(&a.quantity))).collect())
}

fn vector(answer: &Answer) -> Option<Place> {
    if let Answer::Vector { value, .. } = answer { Some(*value) } else { None }
}

/// The same scene with all its points placed; `None` where that cannot be done so simply.
fn by_places(scene: &Value) -> Option<Value> {
    let mut scene = scene.clone();
    let unit = scene["units"]["length"].as_str().unwrap_or("m");
    let si = match unit {
        "m" => 1.0,
        "cm" => 1e-2,
        "mm" => 1e-3,
        "in" => 0.0254,
        "ft" => 0.3048,
        _ => return None,
    };
    let radians = match scene["units"]["angle"].as_str().unwrap_or("deg") {
        "deg" => std::f64::consts::PI / 180.0,
        "rad" => 1.0,
        _ => return None,
    };
    let fixed = keys(&scene, "fixed");
    let mut points = Vec::new();
    let mut add = |name: &str| {
        if !fixed.iter().any(|f| f == name) && !points.iter().any(|p| p == name) {
            points.push(name.to_owned());
        }
    };
    for link in scene["links"].as_object()?.values() {
        link["joins"].as_array()?.iter().filter_map(Value::as_str).for_each(&mut add);
    }
    for slide in scene.get("slides").and_then(Value::as_array).into_iter().flatten() {
        slide.get("pin").and_then(Value::as_str).into_iter().for_each(&mut add);
    }
    let dimensioned: Vec<String> = scene["links"]
        .as_object()?
        .iter()
        .filter(|(_, l)| {
            l["joins"].as_array().is_some_and(|j| j.len() > 1) && l.as_object().is_some_and(|l| l.len() > 1)
        })
        .map(|(n, _)| n.clone())
        .collect();
    let mut names: Vec<String> = points.iter().map(|p| format!("x({p})")).collect();
    names.extend(dimensioned.iter().map(|n| format!("angle({n})")));
    let known = answers(&scene, &names)?;
    let mut placed = Map::new();
    for point in &points {
        let at = vector(&known[&format!("x({point})")])?;
        placed.insert(point.clone(), json!(at.map(|x| x / si)));
    }
    let place = |name: &str| -> Option<Place> {
        let at = placed.get(name).or_else(|| scene["fixed"].get(name))?;
        Some([number(&at[0])?, number(&at[1])?])
    };
    let mut own: BTreeMap<String, Own> = BTreeMap::new();
    for n in &dimensioned {
        let link = &scene["links"][n];
        let Answer::Scalar { value, .. } = known[&format!("angle({n})")] else { return None };
        let first = link["joins"][0].as_str()?;
        let local = if let Some(line) = link.get("line") {
            [number(&line[0])?, 0.0]
        } else if let Some(shape) = link.get("shape") {
            [number(&shape[first][0])?, number(&shape[first][1])?]
        } else {
            [0.0, 0.0]
        };
        let (x, at) = (direction(value), place(first)?);
        let origin = minus(at, [local[0] * x[0] - local[1] * x[1], local[0] * x[1] + local[1] * x[0]]);
        own.insert(n.clone(), Own { origin, angle: value });
    }
    let guide = |guide: &mut Value| -> Option<()> {
        let n = guide.get("link").map_or("1".to_owned(), ToString::to_string);
        let Some(own) = own.get(&n) else { return Some(()) };
        let x = direction(own.angle);
        for key in ["through", "centre"] {
            if let Some(at) = guide.get(key).filter(|p| p.is_array()) {
                let p = [number(&at[0])?, number(&at[1])?];
                let world =
                    [own.origin[0] + p[0] * x[0] - p[1] * x[1], own.origin[1] + p[0] * x[1] + p[1] * x[0]];
                guide[key] = json!(world);
            }
        }
        if guide.get("toward").is_none() && guide.get("radius").is_none() {
            let a = guide.get("angle").map_or(Some(0.0), number)?;
            guide["angle"] = json!(a + own.angle / radians);
        }
        Some(())
    };
    for slide in list(&mut scene, "slides") {
        guide(&mut slide["on"])?;
        if slide.get("link").is_some_and(|n| own.contains_key(&n.to_string())) {
            slide.as_object_mut()?.remove("turned");
        }
    }
    for roll in list(&mut scene, "rolls") {
        if roll.get("line").is_some() {
            guide(&mut roll["line"])?;
        }
    }
    for n in &dimensioned {
        let joins = scene["links"][n]["joins"].clone();
        scene["links"][n] = json!({ "joins": joins });
    }
    let several: Vec<String> = scene["links"]
        .as_object()?
        .iter()
        .filter(|(_, l)| l["joins"].as_array().is_some_and(|j| j.len() > 1))
        .map(|(n, _)| n.clone())
        .collect();
    let free = |input: &mut Value| {
        let link = input.get("link").map(ToString::to_string);
        if let Some(map) = input.as_object_mut() {
            map.remove("at");
            if link.is_some_and(|l| several.contains(&l)) {
                map.remove("angle");
            }
        }
    };
    if let Some(input) = scene.get_mut("input") {
        free(input);
    }
    list(&mut scene, "inputs").into_iter().for_each(free);
    for key in ["near", "where", "published", "errata", "sheet", "vary"] {
        scene.as_object_mut()?.remove(key);
    }
    scene["placed"] = Value::Object(placed);
    Some(scene)
}

fn apart(a: &Answer, b: &Answer) -> Option<(f64, f64)> {
    match (a, b) {
        (Answer::Scalar { value: a, bound }, Answer::Scalar { value: b, bound: other }) => {
            Some(((a - b).abs(), bound + other + 1e-9 * b.abs()))
        }
        (Answer::Vector { value: a, bound }, Answer::Vector { value: b, bound: other }) => {
            Some((length(minus(*a, *b)), bound + other + 1e-9 * length(*b)))
        }
        (Answer::AtInfinity { direction: a, bound }, Answer::AtInfinity { direction: b, bound: other }) => {
            Some((libm::sin(angle(*a) - angle(*b)).abs(), bound + other + 1e-9))
        }
        (Answer::Indeterminate(_), Answer::Indeterminate(_)) => Some((0.0, 1.0)),
        _ => None,
    }
}

fn complaints(name: &str, example: &Value) -> Option<Vec<String>> {
    let mut example = example.clone();
    for key in ["published", "errata", "sheet", "vary", "expect"] {
        example.as_object_mut()?.remove(key);
    }
    let restated = by_places(&example)?;
    // What is asked by a construction is asked as it is.
    let read = scene::read(&example.to_string(), name).unwrap_or_else(|e| panic!("{e}"));
    let names: Vec<String> =
        read.mechanism.asked.iter().map(|a| a.name.clone()).filter(|n| !n.starts_with("angle")).collect();
    let expected = answers(&example, &names)?;
    let mut scene = restated;
    scene["find"] = json!(names);
    let read = match scene::read(&scene.to_string(), name) {
        Ok(read) => read,
        Err(error) => return Some(vec![format!("{name}: {error}\n{scene}")]),
    };
    let largest = |unit: &str| {
        expected
            .iter()
            .filter(|(n, _)| n.starts_with(unit))
            .map(|(_, a)| match a {
                Answer::Scalar { value, .. } => value.abs(),
                Answer::Vector { value, .. } => length(*value),
                _ => 0.0,
            })
            .fold(0.0, f64::max)
    };
    let mut all = Vec::new();
    let mut hold = |solver: &str, n: &String, answer: &Answer| match apart(answer, &expected[n]) {
        Some((apart, allowed)) if apart <= allowed + 1e-9 * largest(&n[..1]) => {}
        Some((apart, allowed)) => {
            all.push(format!("{name}, {solver}: {n} off by {apart:e} of {allowed:e}\n{scene}"))
        }
        None => all.push(format!("{name}, {solver}: {n} is {answer:?}, not {:?}\n{scene}", expected[n])),
    };
    match solve(&read, Extent::Asked, scale::for_scene) {
        Ok(solved) => {
            for (n, reading) in names.iter().zip(&solved.solution.construction.answers) {
                hold("drawn", n, &reading.answer);
            }
        }
        Err(error) => return Some(vec![format!("{name}: {error}\n{scene}")]),
    }
    match solve_analytically(&read) {
        Ok(state) => {
            for (n, asked) in names.iter().zip(&read.mechanism.asked) {
                hold("reckoned", n, &state.answer(&asked.quantity));
            }
        }
        Err(error) => return Some(vec![format!("{name}: {error}\n{scene}")]),
    }
    Some(all)
}

#[test]
fn the_examples_by_places() {
    let mut held = 0;
    let mut all = Vec::new();
    for (name, example) in examples() {
        if example.get("expect").is_some() || example["input"].get("angles").is_some() {
            continue;
        }
        match complaints(&name, &example) {
            Some(found) => {
                held += 1;
                all.extend(found);
            }
            None => println!("{name} is not restated"),
        }
    }
    assert!(all.is_empty(), "{} complaints\n{}", all.len(), all.join("\n\n"));
    assert!(held > 60, "{held} examples");
}
