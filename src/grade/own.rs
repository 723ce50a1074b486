//! What a student drew, as far as what he handed in tells it.

use super::answers::{Given, is_vector};
use super::case::{Case, Target, polygon, size};
use super::judge::Verdict;
use crate::graphical::Sketch;
use crate::graphical::construction::{Label, Mm2, Vector, VectorKind};
use crate::mechanism::quantity::Order;
use crate::sheet::{HandedIn, Own, OwnPoint};

/// How many vectors one after the other may lead to a point.
const CHAIN: usize = 12;

/// A student's polygons: the right ones' vectors between the points that he has, and what he told of others.
pub(super) struct Figures<'f, 's> {
    case: &'f Case<'s>,
    /// What is known of his drawing.
    sketch: &'f Sketch,
    /// Of each answer, whether it is not right.
    amiss: Vec<bool>,
}

/// A point of a polygon that was handed in: the answer, what it is, where it stands on his paper.
struct Point {
    index: usize,
    label: Label,
    letter: Label,
    at: Mm2,
}

impl<'f, 's> Figures<'f, 's> {
    pub(super) fn new(case: &'f Case<'s>, sketch: &'f Sketch, verdicts: &[Verdict]) -> Self {
        let amiss = |verdict: &Verdict| matches!(verdict, Verdict::Wrong | Verdict::Consistent);
        Self { case, sketch, amiss: verdicts.iter().map(amiss).collect() }
    }

    /// Adds them to what is laid over the right figures.
    pub(super) fn add_to(&self, own: &mut Own) {
        for order in [Order::Velocity, Order::Acceleration] {
            let points = self.points(order);
            if !points.is_empty() {
                own.drawn.push(order.diagram());
                self.add_drawn(order, &points, own);
            }
            let vectors = (0..self.amiss.len()).filter(|&index| self.amiss[index]);
            own.vectors.extend(vectors.filter_map(|index| self.vector(order, index)));
        }
    }

    /// Where an answer stands on his paper: his point, the head of his vector, or that of the vector from which it is calculated.
    pub(super) fn place(&self, index: usize) -> Option<(Order, Mm2)> {
        let observation = &self.case.observations[index];
        if let Target::Image(order, _) = observation.target {
            return self
                .points(order)
                .iter()
                .find(|point| point.index == index)
                .map(|point| (order, point.at));
        }
        let of = self.case.read_from(index, self.sketch)?;
        let order = of.order();
        if observation.quantity == Some(of)
            && let Some(own) = self.vector(order, index)
        {
            return Some((order, own.to));
        }
        let vector = *polygon(&self.sketch.construction, order)?.vectors.iter().find(|v| v.quantity == of)?;
        Some((order, self.at(order, vector.head, CHAIN)?))
    }

    /// The points of a polygon that were handed in.
    fn points(&self, order: Order) -> Vec<Point> {
        let si = self.case.si_per_mm(order);
        let all = self.case.observations.iter().enumerate();
        all.filter_map(|(index, observation)| {
            let Target::Image(of, label) = observation.target else { return None };
            let Given::Vector(at) = observation.written.unwrap_or(observation.given) else { return None };
            let letter = observation.letter.unwrap_or(label);
            (of == order).then(|| Point { index, label, letter, at: at.map(|x| x / si) })
        })
        .collect()
    }

    /// Of a polygon whose points were handed in: these, and the vectors between them of which an end is not right. What he
    /// drew besides, nobody knows.
    fn add_drawn(&self, order: Order, points: &[Point], own: &mut Own) {
        let Some(right) = polygon(&self.case.right.construction, order) else { return };
        let known = |label: Label| match label {
            Label::Pole => Some(([0.0; 2], false)),
            _ => {
                let point = points.iter().find(|point| point.label == label)?;
                Some((point.at, self.amiss[point.index]))
            }
        };
        let mut ended: Vec<Label> = Vec::new();
        for vector in &right.vectors {
            let (Some((from, tail)), Some((to, head))) = (known(vector.tail), known(vector.head)) else {
                continue;
            };
            ended.extend([vector.tail, vector.head]);
            if tail || head {
                own.vectors.push(HandedIn {
                    diagram: order.diagram(),
                    from,
                    to,
                    head: vector.head,
                    whole: is_whole(vector.kind),
                });
            }
        }
        for point in points {
            let (diagram, amiss) = (order.diagram(), self.amiss[point.index]);
            own.points.push(OwnPoint {
                diagram,
                label: point.label,
                letter: point.letter,
                at: point.at,
                amiss,
            });
            // An image to which no vector of his leads is one from the pole.
            if amiss && matches!(point.label, Label::Image { .. }) && !ended.contains(&point.label) {
                let (from, to, head) = ([0.0; 2], point.at, point.label);
                own.vectors.push(HandedIn { diagram, from, to, head, whole: true });
            }
        }
    }

    /// A vector that was handed in as such; a magnitude has the direction that the drawing gives it.
    fn vector(&self, order: Order, index: usize) -> Option<HandedIn> {
        let (vector, own) = self.handed_in(order, index)?;
        let from = self.at(order, vector.tail, CHAIN)?;
        let to = [from[0] + own[0], from[1] + own[1]];
        Some(HandedIn { diagram: order.diagram(), from, to, head: vector.head, whole: is_whole(vector.kind) })
    }

    /// The vector of the drawing that an answer tells, and as he has it, mm.
    fn handed_in(&self, order: Order, index: usize) -> Option<(&Vector, Mm2)> {
        let observation = &self.case.observations[index];
        let quantity = observation.quantity.filter(|of| is_vector(of) && of.order() == order)?;
        let vectors = &polygon(&self.sketch.construction, order)?.vectors;
        let vector = vectors.iter().find(|vector| vector.quantity == quantity)?;
        let drawn = [vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]];
        let si = self.case.si_per_mm(order);
        let own = match observation.given {
            Given::Vector(given) => given.map(|x| x / si),
            Given::Magnitude(given) | Given::Drawn(given) if size(&drawn) > 0.0 => {
                drawn.map(|x| x / size(&drawn) * given / si)
            }
            _ => return None,
        };
        Some((vector, own))
    }

    /// Where a point of a polygon stands: as he handed it in, at the end of vectors that he handed in, or as it follows.
    fn at(&self, order: Order, label: Label, chain: usize) -> Option<Mm2> {
        if label == Label::Pole {
            return Some([0.0; 2]);
        }
        if let Some(point) = self.points(order).iter().find(|point| point.label == label) {
            return Some(point.at);
        }
        let leads = |index: &usize| {
            let (vector, own) = self.handed_in(order, *index)?;
            (vector.head == label).then_some((vector.tail, own))
        };
        let mut leading: Vec<(Label, Mm2)> =
            (0..self.amiss.len()).filter_map(|index| leads(&index)).collect();
        // One from the pole needs no other.
        leading.sort_by_key(|(tail, _)| *tail != Label::Pole);
        let before = |&(tail, own): &(Label, Mm2)| {
            let from = self.at(order, tail, chain.checked_sub(1)?)?;
            Some([from[0] + own[0], from[1] + own[1]])
        };
        let follows = || {
            let images = &polygon(&self.sketch.construction, order)?.images;
            images.iter().rev().find(|image| image.label == label).map(|image| image.at)
        };
        leading.iter().find_map(before).or_else(follows)
    }
}

/// Whether a vector is one of those that are drawn thick.
fn is_whole(kind: VectorKind) -> bool {
    matches!(kind, VectorKind::Absolute | VectorKind::Relative)
}
