//! Facts that a scene states twice: the radii of two wheels, and the distance of their centres by what holds it.
//!
//! What contradicts itself is an error that names both. What differs by rounding is one fact, known only as well as the
//! two statements agree: the radii bear the difference as their error, so that whichever of the two a solver uses, its
//! bound covers the other.

use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::links::{index_of, own_coordinates};
use super::placing::{ROUNDING, size};
use crate::mechanism::{Form, Given, LinkId, PointId, Roll};

/// Holds the radii of every pair of wheels against the stated distance of their centres.
pub(super) fn settle(draft: &mut Draft<'_>) -> Res<()> {
    let size = size(draft);
    for index in 0..draft.mechanism.rolls.len() {
        let Roll::Circles { centres, radii, internal, .. } = draft.mechanism.rolls[index] else { continue };
        let [first, second] = radii.map(|radius| radius.value);
        let by_radii = if internal { (first - second).abs() } else { first + second };
        let mut apart: f64 = 0.0;
        for (holder, distance) in distances(draft, centres) {
            let miss = (distance.value - by_radii).abs();
            let known = distance.error + radii[0].error + radii[1].error;
            if miss > ROUNDING * size + known {
                let say = |metres| draft.scales.say_length(metres);
                let [a, b] = centres.map(|centre| draft.say_point(centre));
                let what = format!(
                    "the radii make the distance of {a} and {b} {}, but {} makes it {}",
                    say(by_radii),
                    holder.map_or_else(|| "their places".to_owned(), |link| draft.say(link)),
                    say(distance.value)
                );
                let mend =
                    format!("correct one of the two; up to {} is taken as rounding", say(ROUNDING * size));
                return Err(Fault::new(draft.anchors.rolls[index], what).mend(mend));
            }
            if miss > known {
                apart = apart.max(miss);
            }
        }
        if let Roll::Circles { radii, .. } = &mut draft.mechanism.rolls[index] {
            *radii = radii.map(|radius| radius.with_room(apart));
        }
    }
    Ok(())
}

/// The distance of two centres by the dimensions of every link that has both, and by their places.
fn distances(draft: &Draft<'_>, centres: [PointId; 2]) -> Vec<(Option<LinkId>, Given)> {
    let mut all = Vec::new();
    let distance = |[p, q]: [([f64; 2], f64); 2]| {
        let [dx, dy] = [0, 1].map(|axis| q.0[axis] - p.0[axis]);
        Given::within(libm::hypot(dx, dy), p.1 + q.1)
    };
    for &link in &draft.mechanism.point(centres[0]).links {
        if link == LinkId::FRAME
            || draft.link(link).form == Form::Placed
            || !draft.stands_in(centres[1], link)
        {
            continue;
        }
        let own =
            centres.map(|c| index_of(draft, link, c).and_then(|at| own_coordinates(draft.link(link), at)));
        if let [Some(p), Some(q)] = own {
            all.push((Some(link), distance([p, q])));
        }
    }
    let places = centres.map(|centre| {
        let place = draft.mechanism.point(centre).place.exact()?;
        Some((place.map(|c| c.value), place[0].error + place[1].error))
    });
    if let [Some(p), Some(q)] = places {
        all.push((None, distance([p, q])));
    }
    all
}
