//! Places told from the far end of a chain: what is driven states no angle, and a given place farther along decides how
//! it stands. The same links then are drawn from there, as if they were driven where that place is given; it is
//! only the skeleton that does not ask which of its links drives the others.

use crate::board::Point;
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Rider};
use crate::plan::{CentreSource, Extent, Plan};

use super::draughtsman::Draughtsman;
use super::position::draw_groups;

/// Other inputs by which a skeleton is tried, at most.
const MOST_INPUTS: usize = 8;

impl Draughtsman<'_> {
    /// Finds the places of all points by driving the mechanism where a place is given instead of where its input is. They
    /// count as given from then on. Says whether there were any.
    pub(super) fn lead_from_far_end(&mut self) -> bool {
        self.driven_elsewhere().into_iter().any(|(index, other)| {
            let mut mechanism = self.mechanism.clone();
            mechanism.inputs[index] = other;
            mechanism.asked.clear();
            let before = self.skeleton();
            match self.places_as(&mechanism) {
                Some(places) => {
                    self.pricked = places;
                    true
                }
                None => {
                    self.back_to(&before);
                    false
                }
            }
        })
    }

    /// The places of all points, drawn on the same paper as of this mechanism, which differs by its inputs.
    fn places_as(&mut self, mechanism: &Mechanism) -> Option<Vec<Option<Point>>> {
        let structure = Structure::of(mechanism).ok()?;
        let extent = Extent::WholeSkeleton;
        let plan = Plan::with(mechanism, &structure, extent, CentreSource::Diagram).skeleton();
        let mut other = self.hand_over(mechanism, &structure);
        other.step(Order::Position, &[], Vec::new());
        for point in (0..mechanism.points.len()).map(PointId) {
            if mechanism.is_fixed(point) {
                other.prick_given(point);
            }
        }
        let drawn = draw_groups(&mut other, &plan);
        let places = other.places.clone();
        self.take_back(other);
        drawn.ok().filter(|()| places.iter().all(Option::is_some)).map(|()| places)
    }

    /// Inputs that say nothing of places, by index, each with what is driven in its stead where a place is given: a pin on a
    /// guide of the frame, or a link that turns about a fixed point.
    fn driven_elsewhere(&self) -> Vec<(usize, Input)> {
        let stated = |input: &Input| match input {
            Input::Angle { angle, .. } | Input::Speed { angle, .. } => angle.is_some(),
            Input::Slide { at, .. } => at.is_some(),
        };
        let inputs = &self.mechanism.inputs;
        let silent = (0..inputs.len()).filter(|&index| !stated(&inputs[index]));
        let others = self.inputs_where_given();
        let all = silent.flat_map(|index| {
            others
                .iter()
                .filter(move |other| !is_same(&inputs[index], other))
                .map(move |&other| (index, other))
        });
        all.take(MOST_INPUTS).collect()
    }

    /// What could be driven so that a given place says how it stands. How fast is of no account.
    fn inputs_where_given(&self) -> Vec<Input> {
        let rest = Given::exact(0.0);
        let given = |&point: &PointId| !self.mechanism.is_fixed(point) && self.is_given(point);
        let riders = self.mechanism.slides.iter().enumerate().filter(|(_, slide)| {
            let pin = match slide.rider {
                Rider::Pin { point, .. } => Some(point),
                Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied(),
            };
            slide.guide.link == LinkId::FRAME && pin.as_ref().is_some_and(given)
        });
        let along =
            riders.map(|(slide, _)| Input::Slide { slide, at: None, velocity: rest, acceleration: rest });
        let turning = self.mechanism.moving().filter(|&link| {
            let points = &self.mechanism.link(link).points;
            points.iter().any(|&point| self.mechanism.is_fixed(point)) && points.iter().any(given)
        });
        let about = turning.map(|link| Input::Angle { link, angle: None, omega: rest, alpha: rest });
        along.chain(about).collect()
    }
}

/// Whether two inputs drive the same.
fn is_same(one: &Input, other: &Input) -> bool {
    let driven = |input: &Input| match *input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => (Some(link), None),
        Input::Slide { slide, .. } => (None, Some(slide)),
    };
    driven(one) == driven(other)
}
