//! The same places said as a figure says them: some of the placed points by two loci, some with room.

use serde_json::{Value, json};

use super::mechanism::{Mechanism, Place, angle, cross, direction, left, length, minus, plus, unit};
use super::statement::Units;
use crate::extremes::dice::Dice;

/// Two loci cross at a sine of no less than this.
const CROSSING: f64 = 0.3;
/// Room that is stated for a place, in sizes of the mechanism.
const ROOM: f64 = 1e-7;

/// One locus of a point, as a scene says it, and the direction in which it passes the point.
fn locus(
    m: &Mechanism,
    units: Units,
    dice: &mut Dice,
    (at, stands): (Place, &[usize]),
) -> Option<(Value, Place)> {
    let from = dice.of(stands);
    let name = |p: usize| m.points[p].name.as_str();
    let arm = minus(at, m.at(from));
    if length(arm) < 0.05 * m.size() {
        return None;
    }
    match dice.below(4) {
        0 => Some((json!({ "from": name(from), "distance": length(arm) }), left(arm))),
        1 => Some((json!({ "from": name(from), "direction": angle(arm) / units.angle.1 }), arm)),
        2 => {
            let other = dice.of(stands);
            let far = minus(at, m.at(other));
            let seen = libm::atan2(cross(arm, far), arm[0] * far[0] + arm[1] * far[1]);
            // Too flat an angle is seen from a circle that is nearly a line.
            if other == from || !(0.4..2.7).contains(&seen.abs()) || length(far) < 0.05 * m.size() {
                return None;
            }
            let (ends, seen) = if seen > 0.0 { ([from, other], seen) } else { ([other, from], -seen) };
            // Of the circle through both ends and the point the tangent is square to the radius.
            let [p, q] = ends.map(|p| m.at(p));
            let (a, b) = (minus(p, at), minus(q, at));
            let twice = 2.0 * cross(a, b);
            let (aa, bb) = (a[0] * a[0] + a[1] * a[1], b[0] * b[0] + b[1] * b[1]);
            let centre = [(b[1] * aa - a[1] * bb) / twice, (a[0] * bb - b[0] * aa) / twice];
            let said = json!({ "sees": ends.map(name), "at": seen / units.angle.1 });
            Some((said, left(centre)))
        }
        _ => {
            let along = direction(dice.between(-3.0, 3.0));
            let through = plus(at, along, dice.between(0.1, 0.5) * m.size());
            let guide = json!({ "link": 1, "through": through, "angle": angle(along) / units.angle.1 });
            Some((json!({ "on": guide }), along))
        }
    }
}

/// Says some of the placed points of a scene otherwise.
pub(crate) fn restate(scene: &mut Value, m: &Mechanism, units: Units, dice: &mut Dice) -> Vec<&'static str> {
    let mut ways = Vec::new();
    let mut stands: Vec<usize> = (0..m.points.len()).filter(|p| m.is_fixed(*p)).collect();
    let Some(mut placed) = scene.get("placed").and_then(Value::as_object).cloned() else { return ways };
    let mut order: Vec<usize> =
        (0..m.points.len()).filter(|p| placed.contains_key(&m.points[*p].name)).collect();
    dice.shuffle(&mut order);
    let mut said = serde_json::Map::new();
    let mut near = scene.get("near").and_then(Value::as_object).cloned().unwrap_or_default();
    for point in order {
        let (name, at) = (m.points[point].name.clone(), m.at(point));
        let chosen = dice.below(10);
        if chosen < 5 && stands.len() > 1 {
            let loci: Vec<(Value, Place)> =
                (0..8).filter_map(|_| locus(m, units, dice, (at, &stands))).collect();
            let square = |a: Place, b: Place| cross(unit(a), unit(b)).abs() > CROSSING;
            let pair = (0..loci.len())
                .flat_map(|i| (0..i).map(move |j| (i, j)))
                .find(|&(i, j)| square(loci[i].1, loci[j].1));
            if let Some((i, j)) = pair {
                placed.remove(&name);
                said.insert(name.clone(), json!([loci[i].0, loci[j].0]));
                near.insert(name, json!(at.map(|x| x + 1e-3 * m.size() * dice.between(-1.0, 1.0))));
                ways.push("by loci");
            }
        } else if chosen == 5 && stands.len() > 1 {
            let from = dice.of(&stands);
            let arm = minus(at, m.at(from));
            if length(arm) > 0.05 * m.size() {
                let along = angle(arm) / units.angle.1;
                placed.remove(&name);
                let whole =
                    json!({ "from": m.points[from].name, "distance": length(arm), "direction": along });
                said.insert(name, whole);
                ways.push("laid off");
            }
        } else if chosen == 6 {
            let room = ROOM * m.size();
            let off = direction(dice.between(-3.0, 3.0)).map(|x| x * room * dice.between(0.0, 0.9));
            placed.insert(name, json!({ "at": plus(at, off, 1.0), "within": room }));
            ways.push("with room");
        }
        // What dimensions bind follows from them, and nothing is stated from it.
        if said.contains_key(&m.points[point].name) {
            stands.push(point);
        }
    }
    for (key, map) in [("placed", placed), ("where", said), ("near", near)] {
        if map.is_empty() {
            scene.as_object_mut().map(|scene| scene.remove(key));
        } else {
            scene[key] = Value::Object(map);
        }
    }
    ways
}
