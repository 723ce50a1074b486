//! What the steps have told so far: nothing else may stand in a line, and what is missing is told before it.

use std::cell::RefCell;

use super::notation::Notation;
use super::polygon::seen_from;
use super::printed::{Figures, Key, absolute};
use super::rich::Rich;
use super::steps::{calculated, read};
use crate::graphical::construction::{Act, Calculation, Construction, Diagram, Label, Vector};
use crate::graphical::is_a_point;
use crate::mechanism::quantity::{DiagramKind, Order, Quantity};
use crate::mechanism::{Input, LinkId, PointId};

/// What was given, read or calculated so far: nothing else may stand in a line.
pub(super) struct Known<'a> {
    quantities: Vec<Key>,
    construction: &'a Construction,
    notation: &'a Notation<'a>,
    figures: &'a RefCell<Figures>,
}

impl<'a> Known<'a> {
    pub(super) fn given(
        construction: &'a Construction,
        notation: &'a Notation<'a>,
        figures: &'a RefCell<Figures>,
    ) -> Self {
        let mechanism = notation.mechanism();
        // Of what is driven steadily the steps say what that means for α where they use it.
        let turned = |link: LinkId, alpha: f64| (alpha != 0.0).then_some(Quantity::Alpha(link));
        let inputs = mechanism.inputs.iter().flat_map(|input| match *input {
            Input::Angle { link, alpha, .. } => {
                [Quantity::Omega(link)].into_iter().chain(turned(link, alpha.value)).collect()
            }
            Input::Speed { link, point, alpha, .. } => {
                let first = mechanism.link(link).points.first();
                let stated = first.map(|first| Quantity::RelativeVelocity(point, *first));
                stated.into_iter().chain(turned(link, alpha.value)).collect()
            }
            Input::Slide { .. } => Vec::new(),
        });
        let stated: Vec<Quantity> = inputs.collect();
        let mut known = Self { quantities: Vec::new(), construction, notation, figures };
        stated.into_iter().for_each(|quantity| known.note(quantity, None));
        known
    }

    fn absolute(&self, quantity: Quantity) -> Quantity {
        absolute(quantity, self.notation)
    }

    fn note(&mut self, quantity: Quantity, reference: Option<PointId>) {
        self.quantities.push(Key::from(quantity, reference, self.notation));
    }

    /// The rate that an act uses of a link which turns with another or is driven steadily, before anybody has told it.
    pub(super) fn missing_rate(&mut self, act: &Act) -> Vec<Rich> {
        let Act::Calculate(calculation) = act else { return Vec::new() };
        let (link, order, value) = match *calculation {
            Calculation::Speed { link, omega, .. } | Calculation::Coriolis { link, omega, .. } => {
                (link, Order::Velocity, omega)
            }
            Calculation::Tangential { link, alpha, .. } => (link, Order::Acceleration, alpha),
            _ => return Vec::new(),
        };
        let of = |link: LinkId| match order {
            Order::Acceleration => Quantity::Alpha(link),
            _ => Quantity::Omega(link),
        };
        let key = |link: LinkId| Key::Of(of(link));
        let n = self.notation;
        if self.quantities.contains(&key(link)) {
            return Vec::new();
        }
        let steady = |link: LinkId| {
            let drives = |input: &Input| match *input {
                Input::Angle { link: own, alpha, .. } | Input::Speed { link: own, alpha, .. } => {
                    own == link && alpha.value == 0.0
                }
                Input::Slide { .. } => false,
            };
            order == Order::Acceleration && n.mechanism().inputs.iter().any(drives)
        };
        let told = |other: LinkId| self.quantities.contains(&key(other));
        let constant = |link: LinkId| {
            let parts = [("omega", Quantity::Omega(link)), ("alpha", of(link))];
            Rich::fill(
                n.words.constant_rate,
                &parts.map(|(name, quantity)| (name, n.symbol(quantity, false))),
            )
        };
        if steady(link) {
            self.quantities.push(key(link));
            return vec![constant(link)];
        }
        let mut others = super::derived::turning_with(link, n.mechanism()).into_iter();
        let Some(other) = others.find(|other| told(*other) || value == 0.0 && steady(*other)) else {
            return Vec::new();
        };
        let first = (!told(other)).then(|| constant(other));
        let Some(rate) = super::derived::known_rate(other, order, self.construction, n.mechanism()) else {
            return Vec::new();
        };
        self.quantities.extend([key(other), key(link)]);
        let mut figures = self.figures.borrow_mut();
        first
            .into_iter()
            .chain([super::derived::companion([link, other], of, rate, n, &mut figures)])
            .collect()
    }

    /// The speed that an act uses before anybody has told it, read off the velocity polygon.
    pub(super) fn missing(&mut self, act: &Act) -> Option<Rich> {
        let Act::Calculate(calculation) = act else { return None };
        let (quantity, from, speed) = match *calculation {
            Calculation::Omega { quantity, ends, speed, .. } => (quantity, Some(ends[0]), speed),
            Calculation::Normal { velocity, ends, speed, .. } => (velocity, Some(ends[0]), speed),
            Calculation::SlipNormal { slip, speed, .. } | Calculation::Coriolis { slip, speed, .. } => {
                (slip, None, speed)
            }
            _ => return None,
        };
        let quantity = self.absolute(quantity);
        let key = Key::from(quantity, from, self.notation);
        if speed == 0.0 || self.quantities.contains(&key) {
            return None;
        }
        self.quantities.push(key);
        let polygon = self.construction.diagram(DiagramKind::Velocity)?;
        let ends = self.ends(quantity, key, polygon)?;
        let name = self.notation.symbol_from(quantity, from, false);
        let mm = speed / polygon.si_per_mm;
        let mut figures = self.figures.borrow_mut();
        Some(read(name, ends, (mm, is_a_point(mm)), speed, polygon, self.notation, (&mut figures, key)))
    }

    /// The images between which a velocity lies.
    fn ends(&self, quantity: Quantity, key: Key, polygon: &Diagram) -> Option<[Label; 2]> {
        let of = |v: &Vector| Key::from(v.quantity, seen_from(v, polygon), self.notation);
        let drawn = polygon.vectors.iter().find(|v| of(v) == key);
        if let Some(vector) = drawn {
            return Some([vector.tail, vector.head]);
        }
        let image =
            |point: PointId| polygon.image_of(point, self.notation.mechanism()).map(|image| image.label);
        match quantity {
            Quantity::Velocity(p) => Some([Label::Pole, image(p)?]),
            Quantity::RelativeVelocity(p, q) => Some([image(q)?, image(p)?]),
            _ => None,
        }
    }

    /// What is known after an act.
    pub(super) fn learn(&mut self, act: &Act, diagram: DiagramKind) {
        let diagram = self.construction.diagram(diagram);
        let vector = |index: usize| {
            let vector = diagram?.vectors.get(index)?;
            Some((vector.quantity, seen_from(vector, diagram?)))
        };
        let known = match act {
            Act::ReadVector { vector: index, .. }
            | Act::LayOffVector { vector: index, .. }
            | Act::LayOffFromCentre { vector: index, .. } => vector(*index),
            Act::Calculate(Calculation::Omega { link, .. }) => Some((Quantity::Omega(*link), None)),
            Act::Calculate(Calculation::Alpha { link, .. }) => Some((Quantity::Alpha(*link), None)),
            Act::Calculate(calculation) => calculated(calculation),
            _ => None,
        };
        if let Some((quantity, reference)) = known {
            self.note(quantity, reference);
        }
    }
}
