//! Klein's construction: the velocity and the acceleration polygon of a slider-crank on the crank itself, turned
//! by 90° (F. Klein; also called Ritterhaus's for the acceleration part).
//!
//! 1. The crank is the image of its own velocity turned back by 90°: o on the pivot, a on the crank pin. The scale
//!    is ω times the scale of lengths.
//! 2. V_B lies along the guide and V_BA square to the rod: turned back, the line through o square to the guide
//!    and the rod's own line. They meet in b.
//! 3. Accelerations are drawn against their sense, to ω² times the scale of lengths: the crank is also the image
//!    of Aⁿ of its pin. Aⁿ_BA = V²_BA / AB is the third proportional of AB and ab: the common chord of the circle
//!    on AB and the circle about A with the radius ab cuts it off the rod, and is itself the line of Aᵗ_BA. It
//!    meets the line through o′ along the guide in b′.
//! 4. A crank that gathers speed (ε ≠ 0) has Aᵗ as well: ε/ω² times the crank, square to it at a, and the normal
//!    part of the rod is moved along.

use crate::board::{Amount, Direction, Line, Point};
use crate::given::Given;
use crate::mechanism::Input;
use crate::mechanism::engine::Engine;
use crate::mechanism::quantity::{Order, Quantity};

use super::super::construction::{Calculation, Claim, Label, Reference};
use super::super::draughtsman::Draughtsman;
use super::{AuxiliaryAct, PointName, StrokeRole};

/// Klein's polygons on the skeleton.
pub(in super::super) struct Klein {
    pub(in super::super) crank: Engine,
    omega: Amount,
    pole: Point,
    /// A: a of the velocities.
    pin: Point,
    /// b.
    image: Point,
    /// Through A along the rod.
    rod: Line,
    length: Amount,
    acceleration: Option<Accelerations>,
}

/// The acceleration part.
struct Accelerations {
    /// a′.
    pin: Point,
    /// End of the normal part of the rod.
    foot: Point,
    /// b′.
    image: Point,
}

impl Clone for Klein {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Klein {}

impl Clone for Accelerations {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Accelerations {}

impl Draughtsman<'_> {
    /// Draws the velocity part, and for accelerations both.
    pub(super) fn draw_klein(&mut self, crank: Engine, order: Order) {
        self.board.purpose("Klein's construction");
        let Some((omega, alpha)) = self.crank_rates(crank) else { return };
        if omega.value() == 0.0 {
            self.refuse_auxiliary("Klein's construction needs a crank that turns");
            return;
        }
        let Engine { pivot, crank_pin, slider_pin, rod, slide, .. } = crank;
        let (pole, pin, end) = (self.at(pivot), self.at(crank_pin), self.at(slider_pin));
        let reason = self.reason(&[crank.crank, rod]);
        let (along_rod, _) = self.board.toward(pin, end, reason);
        let (guide, _) = self.tangent(slide, slider_pin);
        let across = self.board.quarter_turn(guide);
        let rod_line = Line { through: pin, along: along_rod };
        let per_mm = self.scales.length();
        self.act_auxiliary(AuxiliaryAct::CrankAsImage {
            crank,
            omega: omega.value(),
            velocity: omega.value().abs() * per_mm,
            acceleration: (order == Order::Acceleration).then(|| omega.value() * omega.value() * per_mm),
        });

        let meet = self.board.meet_lines(Line { through: pole, along: across }, rod_line, reason);
        let image = meet.at;
        if !self.stands(image) {
            self.refuse_auxiliary("the rod stands square to its guide: a dead centre");
        }
        let label = |point| Label::Image { point, link: None };
        let (a, b) = (label(crank_pin), label(slider_pin));
        self.aux_point(PointName::Image(Label::Pole, Order::Velocity), pole);
        self.aux_point(PointName::Image(a, Order::Velocity), pin);
        self.aux_point(PointName::Image(b, Order::Velocity), image);
        let square = Claim::Perpendicular(Reference::Guide(slide));
        let on_rod = Claim::Parallel(Reference::Points(crank_pin, slider_pin));
        self.aux_line(pole, image, StrokeRole::Produced, Some(square));
        self.aux_line(pin, image, StrokeRole::Produced, Some(on_rod));
        self.aux_line(pole, image, StrokeRole::Image, Some(square));
        self.aux_line(pin, image, StrokeRole::Image, Some(on_rod));
        self.act_auxiliary(AuxiliaryAct::AcrossGuide { crank, crossing: meet.crossing });
        let length = self.length(rod, crank_pin, slider_pin);
        let mut klein = Klein { crank, omega, pole, pin, image, rod: rod_line, length, acceleration: None };
        if order == Order::Acceleration {
            let accelerations = self.klein_accelerations(&klein, alpha, end, guide);
            klein.acceleration = Some(accelerations);
        }
        self.kleins.push(klein);
        self.read_klein_images(&klein);
    }

    /// ω and ε of the crank as the input gives them.
    fn crank_rates(&mut self, crank: Engine) -> Option<(Amount, Given)> {
        match self.mechanism.inputs[crank.input] {
            Input::Angle { omega, alpha, .. } => Some((self.board.amount(omega), alpha)),
            Input::Speed { point, speed, alpha, .. } => {
                let &first = self.mechanism.link(crank.crank).points.first()?;
                let length = self.length(crank.crank, first, point);
                let speed = self.board.amount(speed);
                let reason = self.reason(&[crank.crank]);
                Some((self.board.quotient(speed, length, reason), alpha))
            }
            Input::Slide { .. } => None,
        }
    }

    fn klein_accelerations(
        &mut self,
        klein: &Klein,
        alpha: Given,
        end: Point,
        guide: Direction,
    ) -> Accelerations {
        let Klein { crank, omega, pole, pin, image, rod, .. } = *klein;
        let Engine { crank_pin, slider_pin, pivot, slide, .. } = crank;
        let reason = self.reason(&[crank.crank, crank.rod]);
        let ((cut, chord), proportion) = self.third_proportional(pin, end, image, reason);
        self.act_auxiliary(AuxiliaryAct::NormalOnRod { crank, proportion });

        // A crank that gathers speed: a′ leaves a, and the normal part goes with it.
        let (start, foot) = if alpha == Given::exact(0.0) {
            (pin, cut)
        } else {
            let square_of_omega = self.board.product(omega, omega);
            let alpha = self.board.amount(alpha);
            let part = self.board.quotient(alpha, square_of_omega, reason);
            let length = self.length(crank.crank, pivot, crank_pin);
            let tangential = self.board.product(part, length);
            let scale = self.length_scale();
            // Drawn against its sense, as all accelerations here.
            let tangential = self.board.opposite(tangential);
            let mm = self.board.to_paper(tangential, scale);
            let square = self.square_to(crank.crank, pivot, crank_pin);
            let start = self.board.lay_off(pin, square, mm);
            let [normal, _] = self.board.square_off(rod, cut);
            let foot = self.board.lay_off(start, rod.along, normal);
            let radius = Claim::Perpendicular(Reference::Points(pivot, crank_pin));
            self.aux_line(pin, start, StrokeRole::Image, Some(radius));
            self.aux_square(pin, pole, start);
            self.act_auxiliary(AuxiliaryAct::TangentialOnCrank { crank, mm: mm.value().abs() });
            (start, foot)
        };
        let along_guide = Line { through: pole, along: guide };
        let meet = self.board.meet_lines(along_guide, Line { through: foot, along: chord }, reason);
        let on_guide = Claim::Parallel(Reference::Guide(slide));
        let parallel = Claim::Parallel(Reference::Points(crank_pin, slider_pin));
        let square = Claim::Perpendicular(Reference::Points(crank_pin, slider_pin));
        self.aux_line(pole, meet.at, StrokeRole::Produced, Some(on_guide));
        self.aux_line(foot, meet.at, StrokeRole::Produced, Some(square));
        self.aux_line(start, foot, StrokeRole::Image, Some(parallel));
        self.aux_line(foot, meet.at, StrokeRole::Image, Some(square));
        self.aux_line(pole, meet.at, StrokeRole::Image, Some(on_guide));
        self.aux_line(start, meet.at, StrokeRole::Image, None);
        self.aux_square(foot, start, meet.at);
        let label = |point| Label::Image { point, link: None };
        self.aux_point(PointName::Image(Label::Pole, Order::Acceleration), pole);
        self.aux_point(PointName::Image(label(crank_pin), Order::Acceleration), start);
        self.aux_point(PointName::Image(rod_foot(crank), Order::Acceleration), foot);
        self.aux_point(PointName::Image(label(slider_pin), Order::Acceleration), meet.at);
        self.act_auxiliary(AuxiliaryAct::AlongGuide { crank, crossing: meet.crossing });
        Accelerations { pin: start, foot, image: meet.at }
    }

    /// What is read off the images, for the step list.
    fn read_klein_images(&mut self, klein: &Klein) {
        let Klein { crank, omega, pole, pin, image, length, .. } = *klein;
        let Engine { crank_pin, slider_pin, rod, .. } = crank;
        let rate = omega.value();
        let label = |point| Label::Image { point, link: None };
        let (a, b) = (label(crank_pin), label(slider_pin));
        let apart = |p: Point, q: Point| {
            let (p, q) = (p.value(), q.value());
            libm::hypot(q[0] - p[0], q[1] - p[1])
        };
        self.act_auxiliary(AuxiliaryAct::ReadTurned { crank, accelerations: klein.acceleration.is_some() });
        let velocity = rate.abs() * self.scales.length();
        let read = |d: &mut Self, quantity, (tail, p), (head, q), si_per_mm: f64| {
            let mm = apart(p, q);
            d.act_auxiliary(AuxiliaryAct::ReadImage { quantity, tail, head, mm, si_per_mm });
            mm * si_per_mm
        };
        read(self, Quantity::Velocity(slider_pin), (Label::Pole, pole), (b, image), velocity);
        let relative = Quantity::RelativeVelocity(slider_pin, crank_pin);
        let speed = read(self, relative, (a, pin), (b, image), velocity);
        let value = self.klein_omega(klein).value();
        let ends = [crank_pin, slider_pin];
        let omega =
            Calculation::Omega { link: rod, quantity: relative, ends, speed, length: length.value(), value };
        self.act_auxiliary(AuxiliaryAct::Calculate(omega));
        let Some(found) = klein.acceleration else { return };
        let acceleration = rate * rate * self.scales.length();
        read(self, Quantity::Acceleration(slider_pin), (b, found.image), (Label::Pole, pole), acceleration);
        let relative = Quantity::RelativeAcceleration(slider_pin, crank_pin);
        read(self, relative, (b, found.image), (a, found.pin), acceleration);
        let part = Quantity::RelativeTangential(slider_pin, crank_pin);
        let foot = (rod_foot(crank), found.foot);
        let tangential = read(self, part, (b, found.image), foot, acceleration);
        if let Some(alpha) = self.klein_alpha(klein) {
            let (length, value) = (length.value(), alpha.value());
            let alpha = Calculation::Alpha { link: rod, quantity: part, ends, tangential, length, value };
            self.act_auxiliary(AuxiliaryAct::Calculate(alpha));
        }
    }
}

impl Draughtsman<'_> {
    /// ω of the rod: ω of the crank times ab : AB.
    fn klein_omega(&mut self, klein: &Klein) -> Amount {
        let [along, _] = self.board.square_off(klein.rod, klein.image);
        let scale = self.length_scale();
        let image = self.board.read(along, scale);
        let reason = self.reason(&[klein.crank.rod]);
        let ratio = self.board.quotient(image, klein.length, reason);
        self.board.product(klein.omega, ratio)
    }

    /// ε of the rod: ω² of the crank times the tangential part over AB, against the sense in which it is drawn.
    fn klein_alpha(&mut self, klein: &Klein) -> Option<Amount> {
        let found = klein.acceleration?;
        let from = Line { through: found.foot, along: klein.rod.along };
        let [_, across] = self.board.square_off(from, found.image);
        let scale = self.length_scale();
        let part = self.board.read(across, scale);
        let reason = self.reason(&[klein.crank.rod]);
        let ratio = self.board.quotient(part, klein.length, reason);
        let once = self.board.product(klein.omega, ratio);
        let twice = self.board.product(klein.omega, once);
        Some(self.board.opposite(twice))
    }

    /// A vector of the velocity image turned by 90° in the sense of ω.
    fn klein_velocity(&mut self, klein: &Klein, from: Point, to: Point) -> [Amount; 2] {
        let scale = self.length_scale();
        let [x, y] = self.board.between(from, to).map(|mm| self.board.read(mm, scale));
        let [x, y] = [self.board.product(klein.omega, x), self.board.product(klein.omega, y)];
        [self.board.opposite(y), x]
    }

    /// A vector of the acceleration image, against the sense in which it is drawn.
    fn klein_acceleration(&mut self, klein: &Klein, from: Point, to: Point) -> [Amount; 2] {
        let scale = self.length_scale();
        self.board.between(from, to).map(|mm| {
            let real = self.board.read(mm, scale);
            let once = self.board.product(klein.omega, real);
            let twice = self.board.product(klein.omega, once);
            self.board.opposite(twice)
        })
    }

    /// What Klein's construction says of a quantity.
    pub(in super::super) fn klein_answer(&mut self, quantity: &Quantity) -> KleinAnswer {
        let Some(klein) = self.kleins.iter().copied().find(|k| k.crank.leads_to(quantity)) else {
            return KleinAnswer::None;
        };
        let image = |point| if point == klein.crank.crank_pin { klein.pin } else { klein.image };
        let vector = |v| KleinAnswer::Vector(v);
        match (*quantity, klein.acceleration) {
            (Quantity::Velocity(p), _) => vector(self.klein_velocity(&klein, klein.pole, image(p))),
            (Quantity::RelativeVelocity(b, a), _) => vector(self.klein_velocity(&klein, image(a), image(b))),
            (Quantity::Omega(_), _) => KleinAnswer::Scalar(self.klein_omega(&klein)),
            (Quantity::Acceleration(p), Some(found)) => {
                let to = if p == klein.crank.crank_pin { found.pin } else { found.image };
                vector(self.klein_acceleration(&klein, klein.pole, to))
            }
            (Quantity::RelativeAcceleration(b, _), Some(found)) => {
                let ends = [found.pin, found.image];
                let [from, to] = if b == klein.crank.slider_pin { ends } else { [ends[1], ends[0]] };
                vector(self.klein_acceleration(&klein, from, to))
            }
            (Quantity::Alpha(_), Some(_)) => {
                self.klein_alpha(&klein).map_or(KleinAnswer::None, KleinAnswer::Scalar)
            }
            _ => KleinAnswer::None,
        }
    }
}

/// The end of the normal part of the rod.
#[must_use]
pub fn rod_foot(crank: Engine) -> Label {
    Label::Foot { point: crank.slider_pin, link: None, index: 2 }
}

/// What Klein's construction says of a quantity.
pub(in super::super) enum KleinAnswer {
    Vector([Amount; 2]),
    Scalar(Amount),
    /// The construction does not lead there.
    None,
}
