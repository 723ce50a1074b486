//! The drawing as it stands after each step: what the blackboard shows while the lecturer speaks.

use std::collections::HashSet;

use crate::graphical::construction::{Act, Construction, ConstructionLine, Label, Polygon};
use crate::mechanism::{Mechanism, PointId};

/// The construction as it stands after step number `last` (counted from 0).
#[must_use]
pub fn after(construction: &Construction, mechanism: &Mechanism, last: usize) -> Construction {
    let steps = &construction.steps[..construction.steps.len().min(last + 1)];
    let mut all = construction.clone();
    all.steps = steps.to_vec();
    all.answers.clear();
    all.others.clear();
    let drawn = |line: &ConstructionLine| match line {
        ConstructionLine::Ray { step, .. } | ConstructionLine::Arc { step, .. } => *step <= last,
    };
    let mut places = all.space.places.iter_mut().enumerate();
    places
        .by_ref()
        .filter(|(i, _)| !is_placed(construction, mechanism, PointId(*i), last))
        .for_each(|(_, p)| *p = None);
    all.space.lines.retain(drawn);
    for polygon in [&mut all.velocity, &mut all.acceleration] {
        let Some(own) = polygon else { continue };
        own.vectors.retain(|vector| vector.step <= last);
        own.lines.retain(drawn);
        let known = known_images(own, &all.steps);
        own.images.retain(|image| known.contains(&image.label));
        let shown: HashSet<PointId> = own.images.iter().filter_map(|image| point_of(image.label)).collect();
        own.link_images
            .retain(|image| image.corners.iter().all(|(p, at)| shown.contains(p) || *at == [0.0, 0.0]));
        // From the choice of its pole on.
        if !steps.iter().any(|step| step.order == own.order) {
            *polygon = None;
        }
    }
    all
}

fn point_of(label: Label) -> Option<PointId> {
    match label {
        Label::Image { point, .. } => Some(point),
        Label::Pole | Label::Foot { .. } | Label::Trial { .. } => None,
    }
}

/// Whether a point has its place after this step: it is given, a step found it, or its link is solved.
fn is_placed(construction: &Construction, mechanism: &Mechanism, point: PointId, last: usize) -> bool {
    let Some(given) = mechanism.points.get(point.0) else { return false };
    let found = |act: &Act| match act {
        Act::LayOffLink { to: found, .. }
        | Act::LayOffPlace { to: found, .. }
        | Act::MarkIntersection { point: found, .. }
        | Act::TransferPoint { point: found, .. }
        | Act::MarkContact { contact: found } => *found == point,
        _ => false,
    };
    let by = |upto: usize| {
        construction
            .steps
            .iter()
            .take(upto)
            .any(|s| s.acts.iter().any(found) || s.links.iter().any(|link| given.links.contains(link)))
    };
    // What no step mentions is there from the beginning.
    mechanism.is_given(point) || by(last + 1) || !by(construction.steps.len())
}

/// The image points that the steps so far have named, or that a vector drawn so far has at its ends.
fn known_images(polygon: &Polygon, steps: &[crate::graphical::construction::Step]) -> HashSet<Label> {
    let mut known: HashSet<Label> = polygon.vectors.iter().flat_map(|v| [v.tail, v.head]).collect();
    for step in steps.iter().filter(|step| step.order == polygon.order) {
        if step.acts.iter().any(|act| matches!(act, Act::TryPolygon { .. })) {
            known.extend(polygon.images.iter().map(|i| i.label).filter(|l| matches!(l, Label::Trial { .. })));
        }
        known.extend(step.acts.iter().filter_map(|act| match act {
            Act::MarkMeet { label, .. }
            | Act::DivideImage { label, .. }
            | Act::CompleteImage { label, .. }
            | Act::SameImage { label, .. } => Some(*label),
            _ => None,
        }));
    }
    known
}
