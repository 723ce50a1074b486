//! The smallest scene that still shows a fault.

use serde_json::Value;

use super::asked::Asked;
use super::judge::{Fault, judge};

/// Takes away what the fault does not need; the scene, and what is wrong in it.
pub(crate) fn minimise(scene: &Value, asked: &[Asked], fault: &Fault, class: &str) -> (Value, String) {
    let mut asked: Vec<Asked> = match &fault.name {
        Some(name) => asked.iter().filter(|a| a.name == *name).cloned().collect(),
        None => asked.to_vec(),
    };
    let same = |scene: &Value, asked: &[Asked]| {
        !asked.is_empty() && judge(scene, asked).faults.iter().any(|f| super::campaign::class(f) == class)
    };
    let mut scene = scene.clone();
    if !same(&scene, &asked) {
        return (super::judge::asking(&scene, &asked), format!("(not alone) {}", fault.why));
    }
    loop {
        let before = (scene.clone(), asked.len());
        for i in (0..asked.len()).rev() {
            if asked.len() > 1 {
                let mut fewer = asked.clone();
                fewer.remove(i);
                if same(&scene, &fewer) {
                    asked = fewer;
                }
            }
        }
        for part in parts(&scene) {
            let mut smaller = scene.clone();
            if take(&mut smaller, &part) && same(&smaller, &asked) {
                scene = smaller;
            }
        }
        if scene == before.0 && asked.len() == before.1 {
            break;
        }
    }
    let why = judge(&scene, &asked)
        .faults
        .iter()
        .map(|f| format!("{}: {} {}", f.kind, f.name.clone().unwrap_or_default(), f.why))
        .collect::<Vec<_>>()
        .join("\n");
    (super::judge::asking(&scene, &asked), why)
}

/// What may be left out: a link with its slides and rolls, a point, a key.
enum Part {
    Link(String),
    Point(String),
    Key(&'static str, String),
}

fn parts(scene: &Value) -> Vec<Part> {
    let keys = |key: &str| -> Vec<String> {
        scene[key].as_object().map(|o| o.keys().cloned().collect()).unwrap_or_default()
    };
    let mut all: Vec<Part> = keys("links").into_iter().rev().map(Part::Link).collect();
    for key in ["placed", "near", "fixed"] {
        all.extend(keys(key).into_iter().map(Part::Point));
    }
    for key in ["near", "pins", "fixed"] {
        all.extend(keys(key).into_iter().map(|k| Part::Key(key, k)));
    }
    all
}

fn take(scene: &mut Value, part: &Part) -> bool {
    match part {
        Part::Key(key, name) => {
            let Some(map) = scene[*key].as_object_mut() else { return false };
            let taken = map.remove(name).is_some();
            if map.is_empty() {
                scene.as_object_mut().unwrap().remove(*key);
            }
            taken
        }
        Part::Link(number) => {
            let Some(link) = scene["links"].as_object_mut().unwrap().remove(number) else { return false };
            let n: u64 = number.parse().unwrap();
            if let Some(slides) = scene.get_mut("slides").and_then(Value::as_array_mut) {
                slides.retain(|s| s["link"] != n && s["on"]["link"] != n);
            }
            if let Some(rolls) = scene.get_mut("rolls").and_then(Value::as_array_mut) {
                rolls.retain(|r| r["links"].as_array().is_none_or(|l| l.iter().all(|l| *l != n)));
            }
            // Points that no other link has.
            for name in link["joins"].as_array().unwrap() {
                let name = name.as_str().unwrap();
                let elsewhere = scene["links"]
                    .as_object()
                    .unwrap()
                    .values()
                    .any(|l| l["joins"].as_array().unwrap().iter().any(|j| j == name));
                if elsewhere {
                    continue;
                }
                if let Some(slides) = scene.get_mut("slides").and_then(Value::as_array_mut) {
                    slides.retain(|s| s["pin"] != name);
                }
                for key in ["placed", "near", "pins"] {
                    if let Some(map) = scene.get_mut(key).and_then(Value::as_object_mut) {
                        map.remove(name);
                    }
                }
            }
            for key in ["slides", "rolls", "placed", "near", "pins"] {
                let empty = scene.get(key).is_some_and(|v| {
                    v.as_array().is_some_and(Vec::is_empty)
                        || v.as_object().is_some_and(serde_json::Map::is_empty)
                });
                if empty {
                    scene.as_object_mut().unwrap().remove(key);
                }
            }
            true
        }
        Part::Point(name) => {
            // A point of interest of one link.
            let mut taken = false;
            for link in scene["links"].as_object_mut().unwrap().values_mut() {
                if link.get("sides").is_some() || link.get("arms").is_some() || link.get("length").is_some() {
                    continue;
                }
                let joins = link["joins"].as_array_mut().unwrap();
                let Some(i) = joins.iter().position(|j| j == name.as_str()) else { continue };
                if joins.len() < 3 {
                    continue;
                }
                joins.remove(i);
                if let Some(line) = link.get_mut("line").and_then(Value::as_array_mut) {
                    line.remove(i);
                }
                if let Some(shape) = link.get_mut("shape").and_then(Value::as_object_mut) {
                    shape.remove(name);
                }
                taken = true;
            }
            for key in ["placed", "near", "pins"] {
                if let Some(map) = scene.get_mut(key).and_then(Value::as_object_mut) {
                    map.remove(name);
                }
            }
            taken
        }
    }
}
