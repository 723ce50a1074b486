//! Which feet of a polygon a student means. A question names no feet: how he letters them is his own, and so is the order in
//! which he lays off components.

use super::assign::assign;
use crate::graphical::construction::{Diagram, Label, Mm2};
use crate::mechanism::PointId;

/// A line that is drawn passes a point by no more than this, mm and part of its length.
const BESIDE: (f64, f64) = (1.0, 0.02);
/// A foot that is laid off too long or too short is by so much less another one than one beside its line.
const ALONG: f64 = 0.25;
/// So much nearer (mm) another foot must be than the one whose letter it has.
const LETTERED: f64 = 1.0;
/// Components that meet by less than this (sine) are laid off along one line.
const ONE_LINE: f64 = 0.3;

/// A point of a student's polygon: what it is, and where, mm from the pole.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Own {
    pub(super) label: Label,
    pub(super) at: Mm2,
}

/// What each of a student's points is, and where the foot would stand that it is if the components about it had been laid
/// off in the order of the solution.
pub(super) fn meant(right: &Diagram, points: &[Own]) -> Vec<Own> {
    let mut meant = points.to_vec();
    let mut bases: Vec<PointId> = points.iter().filter_map(|own| base(own.label)).collect();
    bases.sort_by_key(|base| base.0);
    bases.dedup();
    for of in bases {
        let feet: Vec<Label> = feet(right).into_iter().filter(|foot| base(*foot) == Some(of)).collect();
        let own: Vec<usize> = (0..points.len()).filter(|&i| base(points[i].label) == Some(of)).collect();
        let costs: Vec<Vec<(usize, f64)>> = own
            .iter()
            .map(|&index| {
                let cost = |(place, foot): (usize, &Label)| {
                    let lettered = if *foot == points[index].label { 0.0 } else { LETTERED };
                    Some((place, lettered + Foot::of(right, points, *foot)?.cost(points[index].at)))
                };
                feet.iter().enumerate().filter_map(cost).collect()
            })
            .collect();
        for (&index, place) in own.iter().zip(assign(&costs)) {
            if let Some(place) = place {
                meant[index].label = feet[place];
            }
        }
    }
    for index in 0..meant.len() {
        if let (Some(_), Some(foot)) = (base(meant[index].label), Foot::of(right, &meant, meant[index].label))
            && let Some(at) = foot.in_the_order_of_the_solution(meant[index].at)
        {
            meant[index].at = at;
        }
    }
    meant
}

/// The point whose feet are told by a letter.
fn base(label: Label) -> Option<PointId> {
    match label {
        Label::Foot { point, .. } => Some(point),
        _ => None,
    }
}

/// The feet of a polygon, each once.
fn feet(right: &Diagram) -> Vec<Label> {
    let mut feet: Vec<Label> = Vec::new();
    for image in &right.images {
        if base(image.label).is_some() && !feet.contains(&image.label) {
            feet.push(image.label);
        }
    }
    feet
}

/// A foot between the points from which and to which components lead.
struct Foot {
    at: Mm2,
    neighbours: Vec<Neighbour>,
}

/// Such a point: where it is right, and where the student has it, if he handed it in.
struct Neighbour {
    right: Mm2,
    own: Option<Mm2>,
}

impl Foot {
    fn of(right: &Diagram, points: &[Own], label: Label) -> Option<Self> {
        let place = |label: Label| match label {
            Label::Pole => Some([0.0; 2]),
            _ => right.images.iter().rev().find(|image| image.label == label).map(|image| image.at),
        };
        let at = place(label)?;
        let mut ends: Vec<(Label, Mm2)> = Vec::new();
        for vector in &right.vectors {
            // Of several feet of one name the one that is meant.
            let other = match (vector.head == label, vector.tail == label) {
                (true, _) if far(vector.to, at) == 0.0 => (vector.tail, vector.from),
                (_, true) if far(vector.from, at) == 0.0 => (vector.head, vector.to),
                _ => continue,
            };
            if far(other.1, at) > 0.0 && !ends.iter().any(|(known, _)| *known == other.0) {
                ends.push(other);
            }
        }
        let own = |of: Label| match of {
            Label::Pole => Some([0.0; 2]),
            _ => points.iter().find(|own| own.label == of).map(|own| own.at),
        };
        let neighbour = |(of, right): (Label, Mm2)| Neighbour { right, own: own(of) };
        Some(Self { at, neighbours: ends.into_iter().map(neighbour).collect() })
    }

    /// How badly a mark fits: how far it lies beside the line of a component from where the student has its other end,
    /// whichever component is laid off first there, and how far along it.
    fn cost(&self, mark: Mm2) -> f64 {
        let from = |neighbour: &Neighbour, component: Mm2| {
            let [across, along] = beside(minus(mark, neighbour.own.unwrap_or(neighbour.right)), component);
            across + ALONG * (along - long(component)).abs()
        };
        let usual = self.neighbours.iter().map(|one| from(one, minus(self.at, one.right)));
        let mut costs: Vec<f64> = usual.collect();
        if let [one, other] = &self.neighbours[..] {
            costs.push(from(one, minus(other.right, self.at)));
            costs.push(from(other, minus(one.right, self.at)));
        }
        costs.into_iter().reduce(f64::min).unwrap_or_else(|| far(mark, self.at))
    }

    /// Where the foot would stand if a mark is one at which the two components meet that are laid off the other way about: the
    /// other corner of their parallelogram.
    fn in_the_order_of_the_solution(&self, mark: Mm2) -> Option<Mm2> {
        let [one, other] = &self.neighbours[..] else { return None };
        let (start, end) = (one.own?, other.own?);
        let [first, second] = [minus(self.at, one.right), minus(other.right, self.at)];
        let sine = (first[0] * second[1] - first[1] * second[0]).abs() / (long(first) * long(second));
        let lies_along = |way: Mm2, component: Mm2| {
            beside(way, component)[0] <= BESIDE.0 + BESIDE.1 * long(way).max(long(component))
        };
        let leads = |first: Mm2, second: Mm2| {
            lies_along(minus(mark, start), first) && lies_along(minus(end, mark), second)
        };
        let corner = [0, 1].map(|axis| start[axis] + end[axis] - mark[axis]);
        (sine > ONE_LINE && leads(second, first) && !leads(first, second)).then_some(corner)
    }
}

/// How far something leads beside a component, and how far along it.
fn beside(way: Mm2, component: Mm2) -> [f64; 2] {
    let length = long(component);
    [
        ((component[0] * way[1] - component[1] * way[0]) / length).abs(),
        (component[0] * way[0] + component[1] * way[1]) / length,
    ]
}

fn minus(a: Mm2, b: Mm2) -> Mm2 {
    [a[0] - b[0], a[1] - b[1]]
}

fn long(way: Mm2) -> f64 {
    libm::hypot(way[0], way[1])
}

fn far(a: Mm2, b: Mm2) -> f64 {
    long(minus(a, b))
}
