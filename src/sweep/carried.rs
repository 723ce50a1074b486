//! The skeleton at one place of a sweep, and the mechanism as it stands there, for whoever solves it by other means.
//!
//! Where the points of a wheel stand adds up on the way, and no equation of one position tells it. Who solves the mechanism
//! there is given them, and has to see besides whether they got there as the wheel rolls.

use super::{Stretch, Sweep, prepare};
use crate::board::{Dual, Variable, Workspace};
use crate::given::Given;
use crate::mechanism::{Form, Input, LinkId, Mechanism, Place, Point, PointId, Roll};

/// Where points stand at one place of the input, and how far wheels have rolled: each with its derivative by the input.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// The points that are drawn, metres in the world.
    pub points: Vec<(PointId, [Dual; 2])>,
    /// The wheels that roll on from where the scene has them, radians since then, ccw.
    pub turned: Vec<(LinkId, Dual)>,
}

/// An error of a sweep is an estimate: a place is known within so many of them.
const ERRORS: f64 = 8.0;

impl Sweep {
    /// The skeleton at a place of one of its stretches. Its numbers are no numbers where the chain does not close.
    #[must_use]
    pub fn skeleton_in(&self, stretch: &Stretch, at: f64) -> Skeleton {
        let transcribed = &self.transcribed;
        let mut place = Workspace::default();
        transcribed.skeleton.look(at, &stretch.signs, &mut place);
        let mut numbers = transcribed.skeleton.asked(&place);
        let mut points = Vec::with_capacity(transcribed.placed.len());
        for &point in &transcribed.placed {
            let (Some(x), Some(y)) = (numbers.next(), numbers.next()) else { break };
            points.push((point, [x, y]));
        }
        Skeleton { points, turned: transcribed.turned.iter().copied().zip(numbers).collect() }
    }

    /// The mechanism as it stands at one place: its inputs there, with their rates, and every point near where the
    /// sweep has it, so that whoever solves it finds the same assembly. The points of wheels that roll on are placed there.
    /// `None` where it cannot be assembled.
    #[must_use]
    pub fn mechanism_at(&self, at: f64) -> Option<Mechanism> {
        if self.is_carried_along() && at == self.start {
            return Some(self.placed.clone());
        }
        let stretch = self.stretch_at(at)?;
        let (ready, variable, _) = &self.ready;
        let mut mechanism = ready.clone();
        mechanism.asked.truncate(self.asked);
        prepare::lead(&mut mechanism, variable, at);
        let skeleton = self.skeleton_in(stretch, at);
        for &(point, at) in &skeleton.points {
            let place = &mut mechanism.points[point.0].place;
            if place.exact().is_none() {
                *place = Place::Near(at.map(|m| m.value));
            }
        }
        for &(wheel, centre) in &self.rolling {
            place_wheel(&mut mechanism, &skeleton, wheel, centre);
        }
        Some(mechanism)
    }

    /// The same as it moves while the place of what is varied grows by one unit in a second: the velocity of a point is the
    /// derivative of its place then.
    #[must_use]
    pub fn led_at(&self, at: f64) -> Option<Mechanism> {
        let mut mechanism = self.mechanism_at(at)?;
        if let Variable::Input(swept) = self.ready.1 {
            for (index, input) in mechanism.inputs.iter_mut().enumerate() {
                let rate = Given::exact(if index == swept { 1.0 } else { 0.0 });
                let still = Given::exact(0.0);
                *input = match *input {
                    Input::Angle { link, angle, .. } | Input::Speed { link, angle, .. } => {
                        Input::Angle { link, angle, omega: rate, alpha: still }
                    }
                    Input::Slide { slide, at, .. } => {
                        Input::Slide { slide, at, velocity: rate, acceleration: still }
                    }
                };
            }
        }
        Some(mechanism)
    }
}

/// Places the points of a wheel where it has carried them; one of a single joint gets a second point, which says how far its
/// own axes have turned.
fn place_wheel(mechanism: &mut Mechanism, skeleton: &Skeleton, wheel: LinkId, centre: PointId) {
    let within = |m: Dual| Given::within(m.value, ERRORS * m.error);
    let drawn =
        |point: PointId| skeleton.points.iter().find(|(p, _)| *p == point).map(|(_, at)| at.map(within));
    let place = |mechanism: &mut Mechanism, point: PointId| {
        let at = drawn(point)?;
        let place = &mut mechanism.points[point.0].place;
        if !matches!(place, Place::Fixed(_)) {
            *place = Place::Placed(at);
        }
        place.exact()
    };
    let Some(at) = place(mechanism, centre) else { return };
    for point in mechanism.link(wheel).points.clone() {
        place(mechanism, point);
    }
    if mechanism.link(wheel).form != Form::Single {
        return;
    }
    let Some((_, by)) = skeleton.turned.iter().find(|(link, _)| *link == wheel) else { return };
    let Some(arm) = radius_of(mechanism, wheel) else { return };
    let (sin, cos) = libm::sincos(by.value);
    let off = ERRORS * by.error + f64::EPSILON;
    let mark = [(at[0], cos), (at[1], sin)].map(|(from, part)| {
        let value = from.value + arm * part;
        Given::within(value, from.error + arm * off + f64::EPSILON * value.abs())
    });
    let point = PointId(mechanism.points.len());
    let number = mechanism.link(wheel).number;
    mechanism.points.push(Point {
        name: format!("the mark of wheel {number}"),
        place: Place::Placed(mark),
        links: vec![wheel],
        journal: None,
    });
    let link = &mut mechanism.links[wheel.0];
    link.points.insert(1, point);
    let [origin, along] = [[0.0, 0.0], [arm, 0.0]].map(|own| own.map(Given::exact));
    link.form = Form::Shape(vec![origin, along]);
}

/// How large a wheel is.
fn radius_of(mechanism: &Mechanism, wheel: LinkId) -> Option<f64> {
    mechanism.rolls.iter().find_map(|roll| match *roll {
        Roll::Circles { links, radii, .. } => {
            links.iter().position(|link| *link == wheel).map(|own| radii[own].value)
        }
        Roll::Line { wheel: own, radius, .. } => (own == wheel).then_some(radius.value),
    })
}
