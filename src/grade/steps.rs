//! What follows from a student's own answers by the solution's own steps: they take their places in the drawing, alone
//! and together, and it is seen where the drawing leads.

use super::case::{Case, Target, polygon, size};
use super::change::Change;
use super::judge::{Verdict, own_values, takes_its_place};
use super::routes::omega_of;
use crate::graphical::construction::Label;
use crate::graphical::{Departure, Sketch};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::{Input, LinkId, PointId, Rider};

/// So many drawings are made at most to see whether one answer follows.
const DRAWINGS: usize = 240;

/// Which of a student's wrong answers take their places in a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum By {
    /// All of them, each alone, and any two.
    Any,
    /// All of them together.
    AllTogether,
}

/// Whether the solution's own steps lead from the student's wrong answers to this one. The right drawing goes on from
/// them, and the drawing as it is known.
pub(super) fn lead_to(
    case: &Case<'_>,
    drawn: &Change,
    verdicts: &[Option<Verdict>],
    (index, by): (usize, By),
    fits: &dyn Fn(&[f64]) -> bool,
) -> bool {
    let judged = |wanted: &[Verdict]| -> Vec<usize> {
        let is = |verdict: Option<Verdict>| verdict.is_some_and(|verdict| wanted.contains(&verdict));
        (0..verdicts.len()).filter(|&other| other != index && is(verdicts[other])).collect()
    };
    let [mut wrong, right] = [&[Verdict::Wrong, Verdict::Consistent][..], &[Verdict::Right]].map(judged);
    // Nothing follows from what is nothing.
    wrong.retain(|&other| !case.hands_in_nothing(other));
    if wrong.is_empty() {
        return false;
    }
    let plain = Change::default();
    let bases: &[&Change] = if drawn.redraws() { &[&plain, drawn] } else { &[&plain] };
    for &base in bases {
        let Some(sketch) = case.drawn(base, None) else { continue };
        if by == By::Any
            && by_image_of_guides(case, &sketch).iter().any(|way| {
                let change = base.and(way);
                let Some(sketch) = case.drawn(&change, None) else { return false };
                case.seen_at(index, &sketch, &change).is_some_and(|numbers| fits(&numbers))
            })
        {
            return true;
        }
        let seen = case.seen(&sketch, base);
        let ways = |of: &[usize]| -> Vec<Vec<Change>> {
            let of = of.iter().map(|&other| {
                let mut ways = ways_of(case, &sketch, other, seen[other].as_deref());
                // What stands in the drawing already is not drawn a second time.
                let stands = |way: &Change| way.departures.iter().all(|own| base.departures.contains(own));
                ways.retain(|way| !stands(way) && takes_its_place(case, &base.and(way), other));
                ways
            });
            of.filter(|ways| !ways.is_empty()).collect()
        };
        let (wrong, right) = (ways(&wrong), ways(&right));
        let leads = |change: &Change| {
            let change = base.and(change);
            let Some(sketch) = case.drawn(&change, None) else { return false };
            let held = [Verdict::Right, Verdict::Consistent];
            case.seen_at(index, &sketch, &change).is_some_and(|numbers| fits(&numbers))
                && is_the_students(case, (verdicts, &held), index, &case.seen(&sketch, &change))
        };
        if tried(&wrong, &right, by).iter().take(DRAWINGS).any(leads) {
            return true;
        }
    }
    false
}

/// Whether a drawing has all that the student handed in before an answer and that is right, or follows (what is `held`): one
/// that has only a part of it is nobody's drawing, and some such leads near any number.
pub(super) fn is_the_students(
    case: &Case<'_>,
    (verdicts, held): (&[Option<Verdict>], &[Verdict]),
    index: usize,
    seen: &[Option<Vec<f64>>],
) -> bool {
    let judged = |other: &usize| {
        // What is wrong may have any cause; what is right, or follows, must stand in the drawing.
        verdicts[*other].is_some_and(|verdict| held.contains(&verdict)) && !case.hands_in_nothing(*other)
    };
    (0..index).filter(judged).all(|other| {
        let own = seen[other].as_deref();
        case.miss(other, own, case.rooms[other].times(HIS * case.times_larger(other, own))) <= 1.0
    })
}

/// An answer is met by a drawing of the student's own numbers if it misses by no more than so many tolerances.
const HIS: f64 = 1.5;

/// Own answers in the drawing: all of them, with and without those that are right; each alone, and any two, where that is
/// wanted.
fn tried(wrong: &[Vec<Change>], right: &[Vec<Change>], by: By) -> Vec<Change> {
    let mut tried = Vec::new();
    let most = wrong.iter().map(Vec::len).max().unwrap_or(0);
    let nth = |ways: &[Vec<Change>], n: usize| {
        let each = ways.iter().filter_map(|ways| ways.get(n).or(ways.last()));
        each.fold(Change::default(), |all, way| all.and(way))
    };
    let held = nth(right, 0);
    for n in 0..most {
        let all = nth(wrong, n);
        tried.push(held.and(&all));
        tried.push(all);
    }
    if by == By::AllTogether {
        return tried;
    }
    for way in wrong.iter().flatten() {
        tried.push(way.clone());
        tried.push(held.and(way));
    }
    for (place, one) in wrong.iter().enumerate() {
        for other in &wrong[place + 1..] {
            for way in one {
                tried.extend(other.iter().map(|more| way.and(more)));
            }
        }
    }
    tried
}

/// How the drawing goes on from one answer of the student.
fn ways_of(case: &Case<'_>, sketch: &Sketch, index: usize, before: Option<&[f64]>) -> Vec<Change> {
    let observation = &case.observations[index];
    let mut ways = own_values(case, sketch, observation, before);
    if let (Target::Asked(_), Some(Quantity::Omega(link) | Quantity::Alpha(link)), Some(&[before])) =
        (observation.target, observation.quantity, before)
    {
        let given = match observation.given {
            super::answers::Given::Signed(value) => Some(value),
            super::answers::Given::Magnitude(size) => Some(if before < 0.0 { -size } else { size }),
            _ => None,
        };
        let order = observation.quantity.map_or(Order::Velocity, |quantity| quantity.order());
        ways.extend(given.into_iter().flat_map(|value| carried(case, sketch, order, link, value)));
    }
    ways.retain(Change::redraws);
    ways
}

/// The points of every link with a guide by proportion from the point under its rider: in either polygon, and in both.
fn by_image_of_guides(case: &Case<'_>, sketch: &Sketch) -> Vec<Change> {
    let mechanism = &case.mechanism;
    let place = |point: PointId| sketch.construction.space.places.get(point.0).copied().flatten();
    let of = |order: Order| -> Vec<Departure> {
        let mut departures = Vec::new();
        for slide in &mechanism.slides {
            let (link, Rider::Pin { point: rider, .. }) = (slide.guide.link, slide.rider) else { continue };
            let points = &mechanism.link(link).points;
            let Some(&pivot) = points.iter().find(|point| mechanism.is_fixed(**point)) else { continue };
            let own = Label::Image { point: rider, link: Some(link) };
            let image = polygon(&sketch.construction, order)
                .and_then(|polygon| polygon.images.iter().rev().find(|image| image.label == own));
            let (Some(image), Some(base), Some(tip)) = (image, place(pivot), place(rider)) else { continue };
            let [x, y] = [tip[0] - base[0], tip[1] - base[1]];
            for &point in points.iter().filter(|point| **point != pivot) {
                let Some(at) = place(point) else { continue };
                let [u, v] = [at[0] - base[0], at[1] - base[1]];
                let square = x * x + y * y;
                let [along, across] = [(u * x + v * y) / square, (v * x - u * y) / square];
                let [p, q] = image.at;
                let at = [along * p - across * q, along * q + across * p];
                departures.push(Departure::Image { order, point, at });
            }
        }
        departures
    };
    let [velocity, acceleration] = [of(Order::Velocity), of(Order::Acceleration)];
    let both = [&velocity[..], &acceleration[..]].concat();
    [velocity, acceleration, both].into_iter().filter(|way| !way.is_empty()).map(Change::drawn).collect()
}

/// The images of a link's points by its own rate, from each of its points that is fixed or driven.
fn carried(case: &Case<'_>, sketch: &Sketch, order: Order, link: LinkId, rate: f64) -> Vec<Change> {
    let space = &sketch.construction.space;
    let points = &case.mechanism.link(link).points;
    let place = |point: PointId| space.places.get(point.0).copied().flatten();
    let driven = |point: PointId| {
        let mut inputs = case.mechanism.inputs.iter();
        inputs.any(|input| match *input {
            Input::Angle { link, .. } => case.mechanism.link(link).points.contains(&point),
            _ => false,
        })
    };
    let image = |point: PointId| {
        if case.mechanism.is_fixed(point) {
            return Some([0.0; 2]);
        }
        let own = Label::Image { point, link: None };
        let images = &polygon(&sketch.construction, order).filter(|_| driven(point))?.images;
        Some(images.iter().rev().find(|image| image.label == own)?.at)
    };
    let si = case.si_per_mm(order);
    let centripetal = match order {
        Order::Acceleration => match omega_of(case, sketch, link) {
            Some(omega) => omega * omega,
            None => return Vec::new(),
        },
        _ => 0.0,
    };
    let mut ways = Vec::new();
    for &from in points {
        let (Some(base), Some(start)) = (image(from), place(from)) else { continue };
        let moved = |&to: &PointId| {
            let end = place(to).filter(|_| to != from && !case.mechanism.is_fixed(to))?;
            let arm = [end[0] - start[0], end[1] - start[1]].map(|mm| mm * space.metres_per_mm);
            let turned = [-rate * arm[1] - centripetal * arm[0], rate * arm[0] - centripetal * arm[1]];
            let at = [base[0] + turned[0] / si, base[1] + turned[1] / si];
            (size(&arm) > 0.0).then_some(Departure::Image { order, point: to, at })
        };
        let departures: Vec<Departure> = points.iter().filter_map(moved).collect();
        if !departures.is_empty() {
            ways.push(Change::drawn(departures));
        }
    }
    ways
}
