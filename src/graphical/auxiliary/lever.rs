//! Zhukovsky's lever: the effort at an input from the velocity polygon and what acts, without any reaction.
//!
//! The velocity polygon is turned by a quarter, clockwise. Every force is laid on the image of the point on which it acts:
//! its moment about the pole is its power, for its arm is the part of the velocity along it. Forces of pairs without
//! friction do no work together, so that the moments of all given forces, of inertia and of the effort are in balance, as
//! on a lever that turns about the pole. A couple acts on the image of its link: its moment is the couple times ω.

use crate::board::{Amount, Direction, Line, Point};
use crate::mechanism::Input;
use crate::mechanism::force::{Action, Force, Heaviness, Inertia, Share, SpringKind};
use crate::mechanism::quantity::Order;
use crate::mechanism::{LinkId, PointId};

use super::super::draughtsman::Draughtsman;
use super::super::forces::ForceRead;
use super::{AuxiliaryAct, NamedPoint, PointName, StrokeRole};

/// The arrow of a force has this length, mm of the page: only its line counts.
const ARROW: f64 = 15.0;
/// An arm shorter than this on the page is none: the line passes through the pole, mm.
const NO_ARM: f64 = 0.05;

/// The effort at an input as the lever gives it.
#[derive(Clone, Copy)]
pub(in super::super) struct ByLever {
    pub(in super::super) input: usize,
    pub(in super::super) effort: Amount,
}

type Found<T> = Result<T, &'static str>;

const NOT_READ: &str = "something that acts could not be laid off on the lever";

impl Draughtsman<'_> {
    /// Draws the lever for the effort at an input.
    pub(super) fn draw_lever(&mut self, input: usize) {
        let before = self.board.purpose("Zhukovsky's lever");
        match self.lever(input) {
            Ok(effort) => self.by_lever.push(ByLever { input, effort }),
            Err(why) => self.refuse_auxiliary(why),
        }
        self.board.purpose(before);
    }

    fn lever(&mut self, input: usize) -> Found<Amount> {
        if let Some(why) = self.mechanism.lever_refused(input) {
            return Err(why);
        }
        let rate = match self.mechanism.inputs[input] {
            Input::Angle { omega, .. } => omega,
            Input::Speed { speed, .. } => speed,
            Input::Slide { velocity, .. } => velocity,
        };
        if rate.value == 0.0 {
            return Err("nothing moves: the velocity polygon is a point, and no force has an arm");
        }
        let pole = self.board.origin();
        self.aux_point(PointName::Image(super::super::construction::Label::Pole, Order::Velocity), pole);
        self.act_auxiliary(AuxiliaryAct::TurnedPolygon);
        let mut moments: Vec<Amount> = Vec::new();
        self.forces_on_the_lever(&mut moments)?;
        self.couples_on_the_lever(&mut moments)?;
        let mut sum = self.rest();
        for moment in &moments {
            sum = self.board.sum(sum, *moment);
        }
        let speed = self.speed_of_effort(input)?;
        let reason = self.reason(self.mechanism.driven_link(input).as_slice());
        let balance = self.board.quotient(sum, speed, reason);
        let effort = self.board.opposite(balance);
        let of = match self.mechanism.driven_link(input) {
            Some(_) => Force::Torque(input),
            None => Force::Drive(input),
        };
        self.act_auxiliary(AuxiliaryAct::EffortOfLever {
            of,
            moments: sum.value(),
            speed: speed.value(),
            effort: effort.value(),
        });
        Ok(effort)
    }

    /// With what the effort does work: ω of the driven link, or the velocity of the driven slide along its guide.
    fn speed_of_effort(&mut self, input: usize) -> Found<Amount> {
        match self.mechanism.inputs[input] {
            Input::Angle { link, .. } | Input::Speed { link, .. } => {
                self.lever_link(link);
                Ok(self.rate(Order::Velocity, link))
            }
            Input::Slide { slide, .. } => {
                let pin = self.mechanism.driven_point(input).ok_or(NOT_READ)?;
                let at = self.at(pin);
                let (along, _) = self.guide_at(slide, at);
                let turned = self.turned_image(pin);
                self.lever_arrow((turned, along), PointName::LeverEffort(input));
                let pole = self.board.origin();
                let image = self.image_of(pin);
                let [part, _] = self.board.square_off(Line { through: pole, along }, image);
                let scale = self.polygon_scale(Order::Velocity);
                Ok(self.board.read(part, scale))
            }
        }
    }

    fn image_of(&mut self, point: PointId) -> Point {
        self.image(Order::Velocity, point)
    }

    /// An image of the velocity polygon, turned by a quarter clockwise.
    fn turned_image(&mut self, point: PointId) -> Point {
        let (pole, image) = (self.board.origin(), self.image_of(point));
        self.board.turned_about(pole, image)
    }

    /// The image of a driven link, named.
    fn lever_link(&mut self, link: LinkId) {
        let points = self.mechanism.link(link).points.clone();
        let moving = points.into_iter().filter(|point| !self.mechanism.is_fixed(*point));
        if let Some(pin) =
            moving.into_iter().find(|point| self.motion(Order::Velocity).images[point.0].is_some())
        {
            let at = self.turned_image(pin);
            self.lever_point(pin, at);
        }
    }

    fn lever_point(&mut self, point: PointId, at: Point) {
        let name = PointName::Image(self.label(point), Order::Velocity);
        let pole = self.board.origin();
        self.aux_point(name, at);
        self.aux_line(pole, at, StrokeRole::Image, None);
    }

    fn lever_arrow(&mut self, (at, along): (Point, Direction), name: PointName) {
        let length = ARROW * self.per_page_of_velocities;
        let [x, y] = at.value();
        let [dx, dy] = along.value();
        let tip = [x + dx * length, y + dy * length];
        let shape = super::StrokeShape::Line([x, y], tip);
        self.note_stroke(super::Stroke { shape, role: StrokeRole::Vector, claim: None });
        self.note_named(NamedPoint { name, at: tip });
    }

    /// Every given force and every inertia force on the image of its point, with the arm of its line about the pole.
    fn forces_on_the_lever(&mut self, moments: &mut Vec<Amount>) -> Found<()> {
        let forces = self.mechanism.forces.clone();
        let mut acting: Vec<(Action, PointId)> = Vec::new();
        for (index, load) in forces.loads.iter().enumerate() {
            acting.extend(load.at().map(|at| (Action::Load(index), at)));
        }
        for mass in &forces.masses {
            if mass.heaviness != Heaviness::None {
                if forces.gravity.acts {
                    acting.push((Action::Weight(mass.link), mass.centre));
                }
                acting.push((Action::Inertia(mass.link), mass.centre));
            }
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            if let SpringKind::Pull(ends) = spring.kind {
                let ends = ends.into_iter().enumerate();
                acting.extend(ends.map(|(end, (_, point))| (Action::Spring { index, end }, point)));
            }
        }
        let mut arms = 0;
        for (action, point) in acting {
            if self.mechanism.is_fixed(point) {
                continue;
            }
            for item in self.items_of(action, Share::Total)? {
                if let Some(pull) = item.pull {
                    let turned = self.turned_image(point);
                    moments.push(self.moment_on_the_lever(action, point, (pull, turned), &mut arms));
                }
            }
        }
        Ok(())
    }

    /// The moment of a force about the pole of the lever: of its two parts, each by its arm.
    fn moment_on_the_lever(
        &mut self,
        action: Action,
        point: PointId,
        (pull, turned): (super::super::forces::Pull, Point),
        arms: &mut usize,
    ) -> Amount {
        let pole = self.board.origin();
        let scale = self.polygon_scale(Order::Velocity);
        let [x, y] = self.board.between(pole, turned);
        let (x, y) = (self.board.read(x, scale), self.board.read(y, scale));
        let [fx, fy] = self.components_of(pull);
        let (ccw, cw) = (self.board.product(x, fy), self.board.product(y, fx));
        let moment = self.board.difference(ccw, cw);
        let size = libm::hypot(fx.value(), fy.value());
        if size <= 0.0 {
            return moment;
        }
        let reason = self.reason(&[]);
        let (along, _) = self.board.toward(pull.tail, pull.head, reason);
        self.lever_point(point, turned);
        self.lever_arrow((turned, along), PointName::LeverForce(action));
        let [beside, arm] = self.board.square_off(Line { through: turned, along }, pole);
        if arm.value().abs() > NO_ARM * self.per_page_of_velocities {
            *arms += 1;
            let foot = self.board.step_off(turned, along, beside);
            self.aux_line(turned, foot, StrokeRole::Produced, None);
            self.aux_line(pole, foot, StrokeRole::Construction, None);
            self.aux_square(foot, pole, turned);
            let half = foot.value().map(|mm| mm / 2.0);
            self.note_named(NamedPoint { name: PointName::LeverArm(*arms), at: half });
            self.act_auxiliary(AuxiliaryAct::MomentOnLever {
                action,
                number: *arms,
                size,
                mm: arm.value().abs(),
                si_per_mm: scale.si_per_mm,
                moment: moment.value(),
            });
        } else {
            self.act_auxiliary(AuxiliaryAct::NoArmOnLever { action });
        }
        moment
    }

    /// Every couple, on the image of its link.
    fn couples_on_the_lever(&mut self, moments: &mut Vec<Amount>) -> Found<()> {
        let forces = self.mechanism.forces.clone();
        let mut acting: Vec<(Force, LinkId, bool)> = Vec::new();
        for (index, load) in forces.loads.iter().enumerate().filter(|(_, load)| load.is_torque()) {
            acting.push((Force::LoadTorque(index), load.link, false));
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            if let SpringKind::Torsion([first, second]) = spring.kind {
                acting.push((Force::Twist(index), first, true));
                acting.push((Force::Twist(index), second, false));
            }
        }
        for mass in forces.masses.iter().filter(|mass| mass.inertia != Inertia::Point) {
            acting.push((Force::InertiaTorque(mass.link), mass.link, false));
        }
        for (of, link, back) in acting {
            if link == LinkId::FRAME || self.translates[link.0] {
                continue;
            }
            let torque = match self.read_force(of, Share::Total) {
                ForceRead::Scalar(torque) => torque,
                ForceRead::Undefined(why) => return Err(why),
                ForceRead::Vector(_) | ForceRead::AtInfinity => return Err(NOT_READ),
            };
            let torque = if back { self.board.opposite(torque) } else { torque };
            let omega = self.rate(Order::Velocity, link);
            let moment = self.board.product(torque, omega);
            if torque.value() != 0.0 && omega.value() != 0.0 {
                self.act_auxiliary(AuxiliaryAct::CoupleOnLever {
                    of,
                    link,
                    torque: torque.value(),
                    omega: omega.value(),
                });
            }
            moments.push(moment);
        }
        Ok(())
    }

    /// The effort at an input as the lever gave it, or why it did not.
    pub(in super::super) fn effort_by_lever(&self, input: usize) -> Found<Amount> {
        let found = self.by_lever.iter().find(|found| found.input == input).map(|found| found.effort);
        found.ok_or_else(|| {
            let refused = self.record().auxiliary.iter().find_map(|drawing| match drawing.kind {
                crate::plan::Auxiliary::Lever { input: of } if of == input => drawing.refused,
                _ => None,
            });
            refused.unwrap_or("the lever was not drawn")
        })
    }
}
