//! Everything that stands on the paper, asked or not: what a sheet shows beside its answers. A check compares it.

use std::collections::HashSet;

use crate::board::{Judged, Tape};
use crate::mechanism::force::Force;
use crate::mechanism::quantity::{Answer, Indeterminate, Order, Quantity};
use crate::mechanism::{LinkId, PointId};

use super::construction::{Construction, Label, Vector};
use super::draughtsman::{Draughtsman, Motion};
use super::forces;

/// A quantity that stands on the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Shown {
    /// What it is.
    pub quantity: Quantity,
    /// SI units; x and y of a vector or a place, one number of anything else.
    value: Vec<f64>,
    /// The direction of a place at infinity; then the number is its angle.
    toward: Option<[f64; 2]>,
    /// Where it stands on the tape.
    slots: Vec<u32>,
}

impl Shown {
    /// As it was read, and as if it were exact.
    #[must_use]
    pub fn as_read(&self) -> Answer {
        self.with_bound(&vec![0.0; self.value.len()])
    }

    /// With its bound, which takes a sweep through the tape for each number; indeterminate where it depends on what is
    /// not determined here.
    #[must_use]
    pub fn answer(&self, tape: &mut Tape) -> Answer {
        if self.is_weak(tape) {
            return Answer::Indeterminate(Indeterminate::DeadCentre { links: Vec::new() });
        }
        let bounds: Vec<f64> = self.slots.iter().map(|slot| tape.bound(*slot)).collect();
        self.with_bound(&bounds)
    }

    /// Whether bounds that are at hand, or nearly so, allow zero. The best one takes a sweep through the tape.
    pub(super) fn looks_like_zero(&self, tape: &mut Tape) -> bool {
        if self.toward.is_some() || matches!(self.quantity, Quantity::Position(_) | Quantity::Centre(..)) {
            return false;
        }
        let size = self.value.iter().fold(0.0, |sum, value| libm::hypot(sum, *value));
        let mut allows = |bound: fn(&mut Tape, u32) -> f64| {
            let bound = self.slots.iter().fold(0.0, |sum, slot| libm::hypot(sum, bound(tape, *slot)));
            // What is no number may be zero.
            size <= bound || size.is_nan() || bound.is_nan()
        };
        allows(Tape::rough_bound) && allows(Tape::nearer_bound)
    }

    /// Where it stands on the tape: two places of a vector, one of anything else.
    pub(super) fn slots(&self) -> &[u32] {
        &self.slots
    }

    /// Its bound, where it is told as zero; `judged` are its numbers.
    pub(super) fn bound_of_zero(&self, judged: &[Judged], construction: &Construction) -> Option<f64> {
        if judged.iter().any(|number| number.weakness.is_some()) {
            return None;
        }
        let bounds: Vec<f64> = judged.iter().map(|number| number.bound).collect();
        match self.with_bound(&bounds) {
            answer @ (Answer::Scalar { bound, .. } | Answer::Vector { bound, .. }) => {
                construction.is_told_as_zero(&self.quantity, &answer).then_some(bound)
            }
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => None,
        }
    }

    /// Whether it depends on what is not determined here.
    #[must_use]
    pub fn is_weak(&self, tape: &mut Tape) -> bool {
        self.slots.iter().any(|slot| tape.weakness(*slot).is_some())
    }

    fn with_bound(&self, bounds: &[f64]) -> Answer {
        match (self.toward, &self.value[..], bounds) {
            (Some(direction), _, &[bound, ..]) => Answer::AtInfinity { direction, bound },
            (None, &[value], &[bound]) => Answer::Scalar { value, bound },
            (None, &[x, y], &[dx, dy]) => Answer::Vector { value: [x, y], bound: libm::hypot(dx, dy) },
            _ => Answer::Indeterminate(Indeterminate::Undefined { why: "nothing was read".to_owned() }),
        }
    }
}

/// Whether a vector is of a trial, and stands for no quantity.
#[must_use]
pub fn is_trial(vector: &Vector) -> bool {
    [vector.tail, vector.head].iter().any(|label| matches!(label, Label::Trial { .. }))
}

/// Reads the places of all points.
pub(super) fn places(d: &mut Draughtsman<'_>) -> Vec<Shown> {
    // The paper is finished: what is read now is not drawn.
    d.silent = true;
    let mut shown: Vec<Shown> = Vec::new();
    for point in (0..d.places.len()).map(PointId) {
        if let Some(at) = d.places[point.0] {
            let numbers = d.in_world(at).map(|amount| (amount.mark(), amount.value()));
            shown.push(of(Quantity::Position(point), None, &numbers));
        }
    }
    shown
}

/// Reads everything that stands on the paper.
pub(super) fn all(d: &mut Draughtsman<'_>) -> Vec<Shown> {
    let mut shown = places(d);
    let forces = d.record().forces.as_ref().map(forces::quantities);
    for quantity in d.standing().into_iter().chain(forces.into_iter().flatten()) {
        if let (Ok(numbers), toward) = d.read_standing(&quantity) {
            shown.push(of(quantity, toward, &numbers));
        }
    }
    shown
}

/// Reads the lines of all forces that were asked or stand on the paper: what each turns about one place of the skeleton,
/// N m. A force that has size and direction right and acts along another line has another moment.
pub(super) fn lines(d: &mut Draughtsman<'_>) -> Vec<Shown> {
    d.silent = true;
    let Some(about) = (0..d.places.len()).map(PointId).find(|point| d.places[point.0].is_some()) else {
        return Vec::new();
    };
    let asked = d.mechanism.asked.iter().map(|asked| asked.quantity);
    let mut moments: Vec<Quantity> = Vec::new();
    for quantity in asked.chain(d.record().forces.iter().flat_map(forces::quantities)) {
        let Quantity::Force(Force::Vector(action), share) = quantity else { continue };
        let moment = Quantity::Force(Force::Moment(action, about), share);
        if !moments.contains(&moment) {
            moments.push(moment);
        }
    }
    let mut lines = Vec::new();
    for moment in moments {
        if let (Ok(numbers), toward) = d.read_standing(&moment) {
            lines.push(of(moment, toward, &numbers));
        }
    }
    lines
}

fn of(quantity: Quantity, toward: Option<[f64; 2]>, numbers: &[(u32, f64)]) -> Shown {
    Shown {
        quantity,
        value: numbers.iter().map(|(_, value)| *value).collect(),
        toward,
        slots: numbers.iter().map(|(mark, _)| *mark).collect(),
    }
}

impl Draughtsman<'_> {
    /// What stands on the polygons and the circle diagram, each once, in the order of drawing.
    fn standing(&self) -> Vec<Quantity> {
        let mut all = Vec::new();
        let of_point = |order, point| match order {
            Order::Acceleration => Quantity::Acceleration(point),
            _ => Quantity::Velocity(point),
        };
        for order in [Order::Velocity, Order::Acceleration] {
            let Motion { images, rotations: rates, .. } = self.motion(order);
            let Some(polygon) = self.polygon(order) else { continue };
            let points = (0..images.len()).map(PointId).filter(|point| images[point.0].is_some());
            all.extend(points.map(|point| of_point(order, point)));
            let under = self.coincident.iter().filter(|under| under.order == order);
            all.extend(under.map(|under| match order {
                Order::Acceleration => Quantity::CoincidentAcceleration(under.pin, under.link),
                _ => Quantity::CoincidentVelocity(under.pin, under.link),
            }));
            // Of the normal part at a contact only the ink is read.
            let vectors = polygon.vectors.iter().filter(|v| !is_trial(v)).map(|v| v.quantity);
            all.extend(vectors.filter(|quantity| !matches!(quantity, Quantity::ContactNormal(..))));
            let links = (0..rates.len()).map(LinkId).filter(|link| rates[link.0].is_some());
            all.extend(links.map(|link| match order {
                Order::Acceleration => Quantity::Alpha(link),
                _ => Quantity::Omega(link),
            }));
        }
        let centres = self.record().circle.iter().flat_map(|circle| &circle.centres);
        all.extend(centres.map(|centre| Quantity::Centre(centre.links[0], centre.links[1])));
        let mut seen = HashSet::new();
        all.retain(|quantity| seen.insert(*quantity));
        all
    }
}

/// Marks and values of a quantity, or why there are none; the direction of a place at infinity.
pub(super) type Standing = (Result<Vec<(u32, f64)>, &'static str>, Option<[f64; 2]>);
