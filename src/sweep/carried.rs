//! The skeleton at one place of a sweep, and the mechanism as it stands there, for whoever solves it by other means.
//!
//! Where the points of a wheel stand adds up on the way, and no equation of one position tells it. Who solves the mechanism
//! there is given them, and has to see besides whether they got there as the wheel rolls.

use super::{Stretch, Sweep, prepare};
use crate::board::{Dual, Variable, Workspace};
use crate::given::Given;
use crate::mechanism::{Form, Input, LinkId, Mechanism, Place, Point, PointId, Rider, Roll, Slide};

/// Where points stand at one place of the input, and how far wheels have rolled: each with its derivative by the input.
#[derive(Debug, Clone, Default)]
pub struct Skeleton {
    /// The points that are drawn, metres in the world.
    pub points: Vec<(PointId, [Dual; 2])>,
    /// The wheels that roll on from where the scene has them, radians since then, ccw.
    pub turned: Vec<(LinkId, Dual)>,
    /// The links of one joint that swivel with the rider of their guide, each with the direction of its x-axis.
    pub swivelling: Vec<(LinkId, [Dual; 2])>,
}

/// A turn, with what rounding adds to it, radians.
const TURN: f64 = std::f64::consts::TAU * (1.0 + 8.0 * f64::EPSILON);

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
        let turned = transcribed.turned.iter().copied().zip(&mut numbers).collect();
        let mut swivelling = Vec::with_capacity(transcribed.swivelling.len());
        for &link in &transcribed.swivelling {
            let (Some(cos), Some(sin)) = (numbers.next(), numbers.next()) else { break };
            swivelling.push((link, [cos, sin]));
        }
        Skeleton { points, turned, swivelling }
    }

    /// The mechanism as it stands at one place: its inputs there, with their rates, and every point near where the
    /// sweep has it, so that whoever solves it finds the same assembly. The points of wheels that roll on are placed there.
    /// `None` where it cannot be assembled.
    #[must_use]
    pub fn mechanism_at(&self, at: f64) -> Option<Mechanism> {
        if self.is_carried_along() && at == self.start {
            return Some(self.placed.clone());
        }
        Some(self.moved_on_to(at)?.0)
    }

    /// The same for whoever does not draw it: a link of one joint that swivels has a second one near its x-axis. At the
    /// scene's own instant that axis points towards the rider; where this has passed the joint since, it points away. There it is
    /// the mechanism as the scene states it, and whoever solves it chooses the assembly for himself.
    #[must_use]
    pub fn marked_at(&self, at: f64) -> Option<Mechanism> {
        if at == self.start
            && let Some(stated) = self.as_stated()
        {
            return Some(stated);
        }
        let (mut mechanism, skeleton) = self.moved_on_to(at)?;
        for (link, axis) in &skeleton.swivelling {
            point_along(&mut mechanism, &skeleton, *link, axis.map(|part| part.value));
        }
        Some(mechanism)
    }

    /// The mechanism as the scene states it, at the place where the sweep has the scene's own. `None` where only the sweep says
    /// how often an input that states no angle has gone round.
    fn as_stated(&self) -> Option<Mechanism> {
        let mut mechanism = self.placed.clone();
        if self.is_carried_along() {
            return Some(mechanism);
        }
        let (_, variable, _) = &self.ready;
        if let &Variable::Input(swept) = variable {
            match mechanism.inputs.get(swept)? {
                Input::Angle { angle: Some(_), .. }
                | Input::Speed { angle: Some(_), .. }
                | Input::Slide { at: Some(_), .. } => prepare::lead(&mut mechanism, variable, self.start),
                Input::Angle { .. } | Input::Speed { .. } if self.range[1] - self.range[0] > TURN => {
                    return None;
                }
                _ => {}
            }
        }
        Some(mechanism)
    }

    /// The mechanism with its inputs at a place, and its points near where they stand there.
    fn moved_on_to(&self, at: f64) -> Option<(Mechanism, Skeleton)> {
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
        Some((mechanism, skeleton))
    }

    /// As [`Sweep::marked_at`], as it moves while the place of what is varied grows by one unit in a second: the velocity of
    /// a point is the derivative of its place then.
    #[must_use]
    pub fn led_at(&self, at: f64) -> Option<Mechanism> {
        let mut mechanism = self.marked_at(at)?;
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
    add_mark(mechanism, wheel, arm, Place::Placed(mark));
}

/// Gives a link of one joint that is swivelled by its guide a second point, near where its x-axis points.
fn point_along(mechanism: &mut Mechanism, skeleton: &Skeleton, link: LinkId, [cos, sin]: [f64; 2]) {
    let rides = |slide: &Slide| matches!(slide.rider, Rider::Link { link: rider, .. } if rider == link);
    let is_driven = |input: &Input| matches!(*input, Input::Angle { link: driven, .. } | Input::Speed { link: driven, .. } if driven == link);
    let told = mechanism.slides.iter().any(rides) || mechanism.inputs.iter().any(is_driven);
    if told || mechanism.link(link).form != Form::Single {
        return;
    }
    let Some(&joint) = mechanism.link(link).points.first() else { return };
    let Some((_, at)) = skeleton.points.iter().find(|(point, _)| *point == joint) else { return };
    let at = at.map(|m| m.value);
    let away = skeleton.points.iter().map(|(_, [x, y])| libm::hypot(x.value - at[0], y.value - at[1]));
    let arm = away.filter(|far| far.is_finite()).fold(0.0, f64::max);
    if arm == 0.0 {
        return;
    }
    let mark = Place::Near([at[0] + arm * cos, at[1] + arm * sin]);
    add_mark(mechanism, link, arm, mark);
}

/// Gives a link of one joint a second point, so far from the joint along its x-axis.
fn add_mark(mechanism: &mut Mechanism, link: LinkId, arm: f64, place: Place) {
    let point = PointId(mechanism.points.len());
    let number = mechanism.link(link).number;
    mechanism.points.push(Point {
        name: format!("the mark of link {number}"),
        place,
        links: vec![link],
        journal: None,
    });
    let link = &mut mechanism.links[link.0];
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
