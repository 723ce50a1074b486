//! What is varied, and the course over it, as JSON.

use serde_json::{Value, json};

use crate::mechanism::quantity::Unit;
use crate::scene::Scene;
use crate::sweep::{Event, EventKind, InputKind, Over, Sweep};

/// The unit of what is varied.
pub(super) fn unit(scene: &Scene, sweep: &Sweep) -> Unit {
    match sweep.input {
        InputKind::Time => scene.units.time.clone(),
        InputKind::Slide(_) => scene.units.length.clone(),
        InputKind::Angle(_) => scene.units.angle.clone(),
    }
}

/// What is varied.
pub(super) fn variable(scene: &Scene, sweep: &Sweep, over: Over) -> Value {
    let (kind, link) = match sweep.input {
        InputKind::Time => ("time", None),
        InputKind::Slide(slide) => ("slide", Some(slide + 1)),
        InputKind::Angle(link) => ("angle", usize::try_from(scene.mechanism.link(link).number).ok()),
    };
    let unit = unit(scene, sweep);
    json!({
        "kind": kind,
        "told": sweep.input.told(&scene.mechanism),
        "of": link,
        "over_time": over == Over::Time,
        "unit": unit.symbol,
        "si": unit.si,
        "start": sweep.start,
        "range": sweep.range,
        "whole_turn": sweep.whole_turn,
        "rate": sweep.rate,
    })
}

/// The stretches and events, as the sweep found them. Centres are told by their first column.
pub(super) fn json(sweep: &Sweep) -> Value {
    let stretches: Vec<Value> = sweep
        .stretches
        .iter()
        .map(|s| json!({ "from": s.from, "to": s.to, "signs": s.signs, "apart": s.apart }))
        .collect();
    let events: Vec<Value> = sweep.events.iter().map(|event| one(sweep, event)).collect();
    json!({ "stretches": stretches, "events": events })
}

fn one(sweep: &Sweep, event: &Event) -> Value {
    let links = sweep.links(event);
    match event.kind {
        EventKind::Limit => json!({ "at": event.at, "kind": "limit", "links": links }),
        EventKind::ChangePoint => json!({ "at": event.at, "kind": "change point", "links": links }),
        EventKind::DeadPosition => json!({ "at": event.at, "kind": "dead position", "links": links }),
        EventKind::AtInfinity { centre, direction } => {
            let column = sweep.centres.get(centre).map(|centre| centre.columns[0]);
            json!({ "at": event.at, "kind": "at infinity", "column": column, "value": direction })
        }
        EventKind::Least { column, value } => extreme(sweep, event.at, "least", column, value),
        EventKind::Greatest { column, value } => extreme(sweep, event.at, "greatest", column, value),
    }
}

fn extreme(sweep: &Sweep, at: f64, kind: &str, column: usize, value: f64) -> Value {
    json!({ "at": at, "kind": kind, "column": column, "value": value, "name": sweep.name_of_extreme(column) })
}
