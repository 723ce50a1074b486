//! Relative velocities that steps read from one image to another, and which no step has drawn: each has its arrow and its name.

use super::notation::Notation;
use super::printed::absolute;
use crate::graphical::construction::{Act, Calculation, Claim, Construction, Reference, Vector, VectorKind};
use crate::graphical::is_a_point;
use crate::mechanism::PointId;
use crate::mechanism::quantity::{DiagramKind, Quantity};

/// The construction with the velocities drawn that normal parts take from images which stand already: of a third point of a
/// link against both others.
#[must_use]
pub fn with_speeds_read(mut construction: Construction, notation: &Notation<'_>) -> Construction {
    let taken = construction.steps.iter().flat_map(|step| &step.acts).filter_map(|act| match act {
        Act::Calculate(Calculation::Normal { velocity, speed, .. }) if *speed != 0.0 => {
            Some(absolute(*velocity, notation))
        }
        _ => None,
    });
    let taken: Vec<Quantity> = taken.collect();
    // When a head was found is told by the vectors of its step.
    let steps: Vec<DiagramKind> = construction.steps.iter().map(|step| step.diagram).collect();
    let kind = DiagramKind::Velocity;
    let Some(last) = steps.iter().rposition(|own| *own == kind) else { return construction };
    let Some(polygon) = construction.diagrams.iter_mut().find(|diagram| diagram.kind == kind) else {
        return construction;
    };
    for quantity in taken {
        let Quantity::RelativeVelocity(point, base) = quantity else { continue };
        let one = |own: Quantity| [quantity, Quantity::RelativeVelocity(base, point)].contains(&own);
        if polygon.vectors.iter().any(|vector| one(vector.quantity)) {
            continue;
        }
        let image = |of: PointId| polygon.image_of(of, notation.mechanism());
        let (Some(tail), Some(head)) = (image(base), image(point)) else { continue };
        let found = polygon.vectors.iter().filter(|v| [v.head, v.tail].contains(&head.label)).map(|v| v.step);
        let (from, to) = (tail.at, head.at);
        let step = found.min().unwrap_or(last);
        polygon.vectors.push(Vector {
            kind: VectorKind::Relative,
            quantity,
            tail: tail.label,
            head: head.label,
            from,
            to,
            claim: Some(Claim::Perpendicular(Reference::Points(base, point))),
            as_point: is_a_point(libm::hypot(to[0] - from[0], to[1] - from[1])),
            is_zero: false,
            step,
        });
    }
    construction
}
