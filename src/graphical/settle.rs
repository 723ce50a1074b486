//! What the bound cannot tell from zero is told nowhere: no arrow, no sense, no number.
//!
//! Lines that meet in one point meet a rounding beside it. The drawing keeps what it computed; what is said of it, in
//! vectors, readings and calculations, is zero where the bound allows zero.

use std::collections::{HashMap, HashSet};

use crate::board::Tape;
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, Mechanism, PointId};

use super::construction::{Act, Calculation, Claim, Construction, Diagram, Reference};
use super::shown::Shown;

/// Where so much work finds it out, it is found out of everything: results by operations on the tape.
const LITTLE: usize = 50_000_000;

/// The quantities that may be zero, with their bounds. In a long drawing from which only numbers are told, only those
/// that are told, and those of diagrams in which nothing is clear of zero.
pub(super) fn zeros(
    shown: &[Shown],
    tape: &mut Tape,
    construction: &Construction,
    is_told: impl Fn(&Quantity) -> bool,
) -> HashMap<Quantity, f64> {
    let mut near: Vec<&Shown> = shown.iter().filter(|shown| shown.looks_like_zero(tape)).collect();
    if near.len().saturating_mul(tape.operations()) > LITTLE {
        let small: HashSet<Quantity> = near.iter().map(|shown| shown.quantity).collect();
        let nothing_else = |diagram: &&Diagram| diagram.vectors.iter().all(|v| small.contains(&v.quantity));
        let noise = construction.diagrams.iter().filter(nothing_else).flat_map(|d| &d.vectors);
        let noise: HashSet<Quantity> = noise.map(|vector| vector.quantity).collect();
        near.retain(|shown| is_told(&shown.quantity) || noise.contains(&shown.quantity));
    }
    let slots: Vec<u32> = near.iter().flat_map(|shown| shown.slots()).copied().collect();
    let judged = tape.judged(&slots);
    let mut judged = judged.as_slice();
    near.into_iter()
        .filter_map(|shown| {
            let (own, rest) = judged.split_at(shown.slots().len());
            judged = rest;
            Some((shown.quantity, shown.bound_of_zero(own, construction)?))
        })
        .collect()
}

/// Adds what a link's not turning says: where it does not turn, none of its points moves about another, and where it does
/// not begin to turn, none has a tangential part. |V| = |ω| r, so that r times the bound of ω bounds it. It is told though no
/// vector shows it, or by a vector that bears the name of the point's whole velocity.
pub(super) fn with_rigid(
    zeros: &mut HashMap<Quantity, f64>,
    mechanism: &Mechanism,
    construction: &Construction,
) {
    let space = &construction.space;
    let place = |point: PointId| space.places.get(point.0).copied().flatten();
    let apart = |a: PointId, b: PointId| {
        let (a, b) = (place(a)?, place(b)?);
        Some(libm::hypot(a[0] - b[0], a[1] - b[1]) * space.metres_per_mm)
    };
    let told = construction.steps.iter().flat_map(|step| &step.acts).filter_map(|act| match act {
        Act::Calculate(Calculation::Normal { velocity: own, .. }) => Some(*own),
        Act::Calculate(
            Calculation::Speed { quantity: own, .. } | Calculation::Tangential { quantity: own, .. },
        ) => Some(*own),
        _ => None,
    });
    for quantity in told {
        let (point, base, rate, of): (_, _, fn(LinkId) -> Quantity, _) = match quantity {
            Quantity::RelativeVelocity(point, base) => (point, base, Quantity::Omega, None),
            Quantity::RelativeTangential(point, base) => (point, base, Quantity::Alpha, None),
            Quantity::TurningVelocity(point, base, link) => (point, base, Quantity::Omega, Some(link)),
            Quantity::TurningTangential(point, base, link) => (point, base, Quantity::Alpha, Some(link)),
            _ => continue,
        };
        let bound = match of {
            Some(link) => zeros.get(&rate(link)).copied(),
            None => {
                let links = mechanism.point(point).links.iter().copied();
                let both = links
                    .filter(|&link| link != LinkId::FRAME && mechanism.link(link).points.contains(&base));
                both.filter_map(|link| zeros.get(&rate(link)).copied()).reduce(f64::min)
            }
        };
        if let (Some(bound), Some(apart)) = (bound, apart(point, base)) {
            zeros.entry(quantity).or_insert(apart * bound);
        }
    }
    for vector in construction.diagrams.iter().flat_map(|diagram| &diagram.vectors) {
        // Its line tells about which point the point of the link turns.
        let Some(
            Claim::Perpendicular(Reference::Points(base, to)) | Claim::Parallel(Reference::Points(base, to)),
        ) = vector.claim
        else {
            continue;
        };
        let omega = |link| zeros.get(&Quantity::Omega(link)).copied();
        let size = match vector.quantity {
            Quantity::CoincidentVelocity(_, link) => omega(link),
            Quantity::CoincidentTangential(_, link) => zeros.get(&Quantity::Alpha(link)).copied(),
            // Aⁿ = ω² r.
            Quantity::CoincidentNormal(_, link) => omega(link).map(|bound| bound * bound),
            _ => None,
        };
        if let (Some(size), Some(apart)) = (size, apart(base, to)) {
            zeros.entry(vector.quantity).or_insert(apart * size);
        }
    }
}

/// Says zero of them wherever something is said of them.
pub(super) fn settle(construction: &mut Construction, zeros: &HashMap<Quantity, f64>) {
    if zeros.is_empty() {
        return;
    }
    // The point of a link under a pin shares its name with other things that are not zero: the value tells.
    let zero =
        |quantity: &Quantity, value: f64| zeros.get(quantity).is_some_and(|bound| value.abs() <= 2.0 * bound);
    for diagram in &mut construction.diagrams {
        for vector in &mut diagram.vectors {
            if zero(&vector.quantity, vector.length() * diagram.si_per_mm) {
                (vector.as_point, vector.is_zero) = (true, true);
            }
        }
    }
    let Construction { diagrams, steps, .. } = construction;
    for step in steps {
        for term in step.equations.iter_mut().flat_map(|e| e.left.iter_mut().chain(&mut e.right)) {
            if term.magnitude.is_some_and(|magnitude| zero(&term.quantity, magnitude)) {
                term.magnitude = Some(0.0);
            }
        }
        for act in &mut step.acts {
            match act {
                Act::ReadVector { vector, mm, value } | Act::LayOffFromCentre { vector, mm, value, .. } => {
                    let read = diagrams.iter().find(|diagram| diagram.kind == step.diagram);
                    if read.and_then(|diagram| diagram.vectors.get(*vector)).is_some_and(|v| v.is_zero) {
                        (*mm, *value) = (0.0, 0.0);
                    }
                }
                Act::Calculate(calculation) => settle_calculation(calculation, zero),
                _ => {}
            }
        }
    }
}

fn settle_calculation(calculation: &mut Calculation, zero: impl Fn(&Quantity, f64) -> bool) {
    let clear = |quantity: Quantity, value: &mut f64| {
        if zero(&quantity, *value) {
            *value = 0.0;
        }
    };
    match calculation {
        Calculation::Speed { quantity, value, .. } => clear(*quantity, value),
        Calculation::Omega { link, quantity, speed, value, .. } => {
            clear(*quantity, speed);
            clear(Quantity::Omega(*link), value);
        }
        Calculation::Normal { quantity, velocity, speed, value, .. } => {
            clear(*velocity, speed);
            clear(*quantity, value);
        }
        Calculation::Tangential { quantity, link, alpha, value, .. } => {
            clear(Quantity::Alpha(*link), alpha);
            clear(*quantity, value);
        }
        Calculation::Alpha { link, quantity, tangential, value, .. } => {
            clear(*quantity, tangential);
            clear(Quantity::Alpha(*link), value);
        }
        Calculation::Coriolis { quantity, link, slip, speed, omega, value } => {
            clear(*slip, speed);
            clear(Quantity::Omega(*link), omega);
            clear(*quantity, value);
        }
        Calculation::SlipNormal { quantity, slip, speed, value, .. } => {
            clear(*slip, speed);
            clear(*quantity, value);
        }
        Calculation::Rub { links: [i, j], first, second, .. } => {
            clear(Quantity::Omega(*i), first);
            clear(Quantity::Omega(*j), second);
        }
        Calculation::Translation { .. } => {}
    }
}
