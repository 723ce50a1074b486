//! Feet of components that would share a name are told apart: each place of a polygon has its own.

use super::notation::Notation;
use crate::graphical::construction::{Act, Construction, Diagram, Label, Mm2};
use crate::mechanism::quantity::DiagramKind;

/// Places closer than this are one.
const SAME: f64 = 1e-6;

/// The construction with each foot's link stated and its index such that no two places share a name.
#[must_use]
pub fn told_apart(construction: &Construction, notation: &Notation<'_>) -> Construction {
    let mut all = construction.clone();
    let kind = DiagramKind::Acceleration;
    let new = all.diagrams.iter_mut().find(|diagram| diagram.kind == kind);
    let (Some(old), Some(new)) = (construction.diagram(kind), new) else { return all };
    let mut feet = Feet { notation: *notation, named: Vec::new() };
    for vector in &mut new.vectors {
        vector.tail = feet.name(vector.tail, vector.from);
        vector.head = feet.name(vector.head, vector.to);
    }
    for image in &mut new.images {
        image.label = feet.name(image.label, image.at);
    }
    // A line is drawn from the foot that was laid off last under its name.
    for step in all.steps.iter_mut().filter(|step| step.diagram == kind) {
        let mut last: Vec<(Label, Label)> = Vec::new();
        for act in &mut step.acts {
            match act {
                Act::LayOffVector { vector, .. } => last.extend(ends(old, new, *vector)),
                Act::DrawRay { from, .. } => {
                    if let Some((_, name)) = last.iter().rev().find(|(before, _)| before == from) {
                        *from = *name;
                    }
                }
                _ => {}
            }
        }
    }
    all
}

/// A point of a polygon under the name that tells it apart from all others; as it is, where the polygon has no such point.
pub(super) fn printed(
    construction: &Construction,
    notation: &Notation<'_>,
    (kind, label): (DiagramKind, Label),
) -> Label {
    let all = told_apart(construction, notation);
    let (Some(old), Some(new)) = (construction.diagram(kind), all.diagram(kind)) else { return label };
    let mut pairs = old.images.iter().zip(&new.images).rev();
    pairs.find(|(old, _)| old.label == label).map_or(label, |(_, new)| new.label)
}

/// The names of a vector's ends before and after.
fn ends(old: &Diagram, new: &Diagram, vector: usize) -> Vec<(Label, Label)> {
    let (Some(old), Some(new)) = (old.vectors.get(vector), new.vectors.get(vector)) else {
        return Vec::new();
    };
    vec![(old.tail, new.tail), (old.head, new.head)]
}

struct Feet<'a> {
    notation: Notation<'a>,
    /// Name as constructed, place, name as drawn.
    named: Vec<(Label, Mm2, Label)>,
}

impl Feet<'_> {
    fn name(&mut self, label: Label, at: Mm2) -> Label {
        let Label::Foot { point, link, index } = label else { return label };
        let link = link.or_else(|| self.notation.home(point));
        let here = |p: &Mm2| libm::hypot(p[0] - at[0], p[1] - at[1]) < SAME;
        let known = self.named.iter().find(|(old, p, _)| *old == label && here(p));
        if let Some((.., name)) = known {
            return *name;
        }
        let mut name = Label::Foot { point, link, index };
        let mut next = index;
        while next < u8::MAX && self.named.iter().any(|(_, p, taken)| *taken == name && !here(p)) {
            next += 1;
            name = Label::Foot { point, link, index: next };
        }
        self.named.push((label, at, name));
        name
    }
}
