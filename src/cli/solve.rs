//! `linkgram solve`.

use std::fmt::Write;
use std::path::Path;

use serde_json::{Map, Value, json};

use super::report::{describe, short};
use super::{Ending, Failure, failure, print, read_scene};
use crate::check::{Agreement, Compared};
use crate::mechanism::quantity::{Answer, Asked, Method, Quantity};
use crate::plan::Extent;
use crate::scene::Scene;

pub(super) fn run(path: &Path, as_json: bool, explain: bool) -> Result<Ending, Failure> {
    let (file, scene) = read_scene(path)?;
    let scene = &scene;
    let solved = crate::solve::solve(scene, Extent::Asked, crate::sheet::scale::for_scene)
        .map_err(|error| failure(scene, &error))?;
    let agreement = crate::check::agreement(scene, &solved, &crate::solve::solve_analytically(scene));
    let explanation = explain.then(|| {
        let circle = solved.solution.construction.circle.as_ref();
        let centres = circle.map_or_else(String::new, |c| c.explain(&scene.mechanism).to_string());
        solved.plan.explain(&scene.mechanism, &solved.structure).to_string() + &centres
    });
    let text = if as_json {
        let mut object = object(&file, scene, &solved, &agreement);
        if let (Some(explanation), Some(map)) = (&explanation, object.as_object_mut()) {
            let lines: Vec<&str> = explanation.lines().collect();
            map.insert("explain".to_owned(), json!(lines));
        }
        serde_json::to_string_pretty(&object).map_err(|error| Failure(error.to_string()))? + "\n"
    } else {
        table(&solved, &agreement) + explanation.as_deref().unwrap_or("")
    };
    print(&text)?;
    let determined = agreement.compared.iter().all(|c| c.indeterminate().is_none());
    Ok(if agreement.ok() && determined { Ending::Fine } else { Ending::DoesNotHold })
}

fn table(solved: &crate::solve::Solved, agreement: &Agreement) -> String {
    let mut out = String::new();
    let _ = writeln!(out, "{}", solved.structure.mobility);
    let width = agreement.compared.iter().map(|c| named(&c.asked).len()).max().unwrap_or(0);
    for compared in &agreement.compared {
        let asked = &compared.asked;
        let _ = write!(out, "{:width$}  {}", named(asked), describe(asked, &compared.graphical.answer));
        let _ = match (compared.difference, compared.indeterminate()) {
            (Some(d), _) => writeln!(
                out,
                "   analytic {}   difference {:.1e} ({:.2} of the bounds)",
                describe(asked, &compared.analytic),
                d.value / asked.unit.si,
                d.ratio
            ),
            (None, _) => writeln!(out, "   analytic {}", describe(asked, &compared.analytic)),
        };
    }
    let _ = writeln!(out, "{}", verdict(agreement));
    out
}

/// The name of a quantity, with the method by which it is asked where that is not the polygon.
fn named(asked: &Asked) -> String {
    match asked.method {
        Method::Polygon => asked.name.clone(),
        method => format!("{} by {}", asked.name, method.name()),
    }
}

/// One line on the agreement of the two solvers.
pub(super) fn verdict(agreement: &Agreement) -> String {
    if let Some(refused) = &agreement.refused {
        return format!("the analytic solver refused: {refused}");
    }
    if let Some(point) = &agreement.wrong_branch {
        return format!("wrong branch: the two solvers see {point} in different places");
    }
    let worst = agreement.worst_ratio();
    let said = if agreement.ok() { "agree" } else { "DO NOT AGREE" };
    format!("graphical and analytic {said}: worst difference is {} of the bounds", short(worst))
}

fn object(file: &str, scene: &Scene, solved: &crate::solve::Solved, agreement: &Agreement) -> Value {
    let quantities: Vec<Value> = agreement.compared.iter().map(quantity).collect();
    let mut verdict_of = json!({ "worst_ratio": agreement.worst_ratio(), "ok": agreement.ok() });
    if let (false, Some(map)) = (agreement.ok(), verdict_of.as_object_mut()) {
        map.insert("why".to_owned(), json!(verdict(agreement)));
    }
    json!({
        "scene": scene.title.in_language("en").unwrap_or(file),
        "degrees_of_freedom": solved.structure.mobility.freedoms,
        "mobility": solved.structure.mobility.to_string(),
        "quantities": quantities,
        "agreement": verdict_of,
    })
}

fn quantity(compared: &Compared) -> Value {
    let asked = &compared.asked;
    let mut map = Map::new();
    map.insert("name".to_owned(), json!(asked.name));
    map.insert("unit".to_owned(), json!(asked.unit.symbol));
    if asked.method != Method::Polygon {
        map.insert("method".to_owned(), json!(asked.method.name()));
    }
    if let Some(why) = compared.indeterminate() {
        map.insert("indeterminate".to_owned(), json!(why.to_string()));
        return Value::Object(map);
    }
    insert_value(&mut map, asked, &compared.graphical.answer);
    let in_unit = |x: f64| json!(x / asked.unit.si);
    match &compared.analytic {
        Answer::Scalar { value, bound } => {
            map.insert("analytic".to_owned(), in_unit(*value));
            map.insert("analytic_bound".to_owned(), json!(bound_in_unit(*bound, *value, asked.unit.si)));
        }
        Answer::Vector { value, bound } => {
            map.insert("analytic".to_owned(), json!(value.map(|v| v / asked.unit.si)));
            let magnitude = libm::hypot(value[0], value[1]);
            map.insert("analytic_bound".to_owned(), json!(bound_in_unit(*bound, magnitude, asked.unit.si)));
        }
        Answer::AtInfinity { direction, .. } => {
            map.insert("analytic_direction_deg".to_owned(), json!(half_turn(*direction)));
        }
        Answer::Indeterminate(_) => {}
    }
    if let Some(difference) = compared.difference {
        let factor = if matches!(compared.analytic, Answer::AtInfinity { .. }) { 1.0 } else { asked.unit.si };
        map.insert("difference".to_owned(), json!(difference.value / factor));
    }
    if let Some(mm) = compared.graphical.drawn_mm {
        map.insert("drawn_mm".to_owned(), json!(mm));
    }
    Value::Object(map)
}

/// A bound in the unit of the answer, with the roundings that this costs: the unit's own two and the
/// division.
fn bound_in_unit(bound: f64, value: f64, si: f64) -> f64 {
    bound / si + (value / si).abs() * 1.5 * f64::EPSILON
}

/// Direction of a centre at infinity, degrees in [0, 180).
fn half_turn(direction: [f64; 2]) -> f64 {
    libm::atan2(direction[1], direction[0]).to_degrees().rem_euclid(180.0)
}

fn insert_value(map: &mut Map<String, Value>, asked: &Asked, answer: &Answer) {
    let si = asked.unit.si;
    let bound_of = |bound, value| json!(bound_in_unit(bound, value, si));
    match answer {
        Answer::Scalar { value, bound } => {
            map.insert("value".to_owned(), json!(value / si));
            let has_sense = matches!(
                asked.quantity,
                Quantity::Omega(_)
                    | Quantity::RelativeOmega(..)
                    | Quantity::Alpha(_)
                    | Quantity::RelativeAlpha(..)
            );
            if has_sense && *value != 0.0 {
                let sense = if *value > 0.0 { "ccw" } else { "cw" };
                map.insert("sense".to_owned(), json!(sense));
            }
            map.insert("bound".to_owned(), bound_of(*bound, *value));
        }
        Answer::Vector { value, bound } => {
            let [x, y] = value.map(|v| v / si);
            let magnitude = libm::hypot(x, y);
            map.insert("value".to_owned(), json!([x, y]));
            map.insert("magnitude".to_owned(), json!(magnitude));
            if magnitude > 0.0 {
                map.insert("direction_deg".to_owned(), json!(libm::atan2(y, x).to_degrees()));
            }
            map.insert("bound".to_owned(), bound_of(*bound, magnitude * si));
        }
        Answer::AtInfinity { direction, bound } => {
            map.insert("at_infinity".to_owned(), json!(true));
            map.insert("direction_deg".to_owned(), json!(half_turn(*direction)));
            map.insert("bound".to_owned(), json!(bound.to_degrees()));
        }
        Answer::Indeterminate(_) => {}
    }
}
