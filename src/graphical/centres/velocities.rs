//! Velocities from instant centres (`s000-ch3b` A 14 to 20, C).
//!
//! - *Direct*: the centre (i k) of input and sought link has one velocity in both, so that
//!   ω_k : ω_i = (1i–ik) : (1k–ik); V of a point is ω times its distance from the pole, square to that radius.
//! - *Line of centres*: V of the transfer centre (i k) is laid off square to the line of centres; the gauge line from
//!   the pole (1k) through its tip gives V at the same distance of the point, turned about (1k) onto that line.
//! - *Gauge line*: the same from pin to pin along a chain of links.
//! - *Link to link*: V of a pin is turned by 90° onto its line to the pole; a parallel to the link cuts the line from
//!   the next pin to the same pole, and what it cuts off is the velocity of that pin, turned back. Only the
//!   *directions* to the poles are used: they may lie off the sheet.

use crate::board::{Amount, HomogeneousPoint, Line, Location, Mm, Point, Scale};
use crate::mechanism::quantity::{Method, Order, Quantity};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::{chain, chord, driver, home, transfer_home};

use super::super::construction::{Spot, Transfer, TransferAct, TransferInk};
use super::super::draughtsman::Draughtsman;
use super::super::velocity::FLATTEST_CROSSING;

/// Why a method does not lead to a quantity, in plain English.
pub(in super::super) type Why = &'static str;

/// The motion of a link: its pole, and its rate about it (ω over the pole's weight; for a pole at infinity the
/// velocity of the translation).
struct Twist {
    pole: HomogeneousPoint,
    rate: Amount,
}

impl Clone for Twist {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Twist {}

/// The mechanism is not driven in a way from which the methods can start.
pub(in super::super) const NO_INPUT: Why =
    "velocities from centres need one input, at a link or at a slide of the frame";
const NO_POLE: Why = "the circle diagram does not lead to the centres that this velocity needs";
const COINCIDENT: Why =
    "the centres that this velocity needs fall on each other here; ask for it by the polygon";
const OFF_SHEET: Why = "a centre lies at infinity here; the method \"link-to-link\" needs its direction only";
const NO_CHAIN: Why =
    "no chain of pins leads there from the input link; ask for it by the method \"centres\"";

impl Draughtsman<'_> {
    /// A velocity or an angular velocity from centres.
    pub(in super::super) fn velocity_from_centres(
        &mut self,
        quantity: Quantity,
        method: Method,
    ) -> Result<FromCentres, Why> {
        self.board.purpose("velocity from centres");
        match method {
            Method::LineOfCentres => self.by_line_of_centres(quantity),
            Method::GaugeLine | Method::LinkToLink => self.by_chain(quantity, method),
            _ => self.directly(quantity),
        }
    }

    // --- the direct method ---------------------------------------------------------------------

    fn directly(&mut self, quantity: Quantity) -> Result<FromCentres, Why> {
        let of = |point: PointId, d: &Self| {
            transfer_home(d.mechanism, d.structure, point).unwrap_or(LinkId::FRAME)
        };
        match quantity {
            Quantity::Velocity(p) => self.velocity_of_point(p, of(p, self), true).map(FromCentres::Vector),
            Quantity::CoincidentVelocity(p, l) => self.velocity_of_point(p, l, true).map(FromCentres::Vector),
            Quantity::RelativeVelocity(b, a) => self.against(quantity, (b, of(b, self)), (a, of(a, self))),
            Quantity::Slip(p, l) => self.against(quantity, (p, of(p, self)), (p, l)),
            Quantity::Omega(l) => self.omega_of(l, true).map(FromCentres::Scalar),
            Quantity::RelativeOmega(i, j) => {
                let (first, second) = (self.omega_of(i, true)?, self.omega_of(j, true)?);
                Ok(FromCentres::Scalar(self.board.difference(first, second)))
            }
            Quantity::Ratio(i, j) | Quantity::Advantage(j, i) => {
                let (first, second) = (self.omega_of(i, true)?, self.omega_of(j, true)?);
                let reason = self.reason(&[j]);
                Ok(FromCentres::Scalar(self.board.quotient(first, second, reason)))
            }
            Quantity::Rub(pin, i, j) => {
                let Some(journal) = self.mechanism.point(pin).journal else {
                    return Err("the pin has no journal radius");
                };
                let (first, second) = (self.omega_of(i, true)?, self.omega_of(j, true)?);
                let relative = self.board.difference(first, second);
                let relative = self.board.magnitude(relative);
                let radius = self.board.amount(journal);
                Ok(FromCentres::Scalar(self.board.product(radius, relative)))
            }
            _ => Err("centres give velocities only"),
        }
    }

    /// The velocity of a point of a link against that of a point of another: what lies between the tips of both, drawn
    /// from one place.
    fn against(
        &mut self,
        quantity: Quantity,
        (b, of_b): (PointId, LinkId),
        (a, of_a): (PointId, LinkId),
    ) -> Result<FromCentres, Why> {
        let (first, second) =
            (self.velocity_of_point(b, of_b, true)?, self.velocity_of_point(a, of_a, true)?);
        let relative = [0, 1].map(|k| self.board.difference(first[k], second[k]));
        // Against the frame nothing is taken away.
        if of_a != LinkId::FRAME {
            let paper = self.polygon_scale(Order::Velocity);
            let (of, against) = (self.spot(b, of_b), self.spot(a, of_a));
            let foot = self.at(b);
            if a != b {
                self.draw_velocity(against, foot, second);
            }
            let [to, from] = [first, second].map(|velocity| self.tip(foot, velocity, paper));
            let mm = self.board.distance(from, to).value();
            let speed = libm::hypot(relative[0].value(), relative[1].value());
            let [foot, from, to] = [foot, from, to].map(|at| at.value());
            self.draw_transfer(TransferInk::Difference { foot, from, to, of: quantity });
            self.tell(TransferAct::Difference { quantity, of, against, mm, speed });
        }
        Ok(FromCentres::Vector(relative))
    }

    /// A point as one of this link.
    fn spot(&self, point: PointId, link: LinkId) -> Spot {
        if link == LinkId::FRAME || self.mechanism.link(link).points.contains(&point) {
            Spot::Point(point)
        } else {
            Spot::Under(point, link)
        }
    }

    /// V of a point of a link: its rate about the pole times the radius.
    pub(super) fn velocity_of_point(
        &mut self,
        point: PointId,
        link: LinkId,
        tell: bool,
    ) -> Result<[Amount; 2], Why> {
        if link == LinkId::FRAME {
            return Ok([self.rest(), self.rest()]);
        }
        let twist = self.twist(link, tell)?;
        let (at, scale) = (self.at(point), self.length_scale());
        let velocity = self.board.velocity_about(twist.pole, twist.rate, at, scale);
        if tell {
            let speed = libm::hypot(velocity[0].value(), velocity[1].value());
            let reason = self.reason(&[link]);
            match self.board.locate(twist.pole, reason) {
                Location::At(pole) => {
                    let radius = self.board.distance(pole, at).value();
                    let omega = self.board.turning(twist.pole, twist.rate).value();
                    self.tell(TransferAct::AboutPole { link, point, mm: radius, omega, speed });
                    self.draw_transfer(TransferInk::Radius { from: pole.value(), to: at.value() });
                }
                Location::Toward(..) => self.tell(TransferAct::Translation { link, speed }),
            }
            self.draw_velocity(self.spot(point, link), at, velocity);
        }
        Ok(velocity)
    }

    pub(super) fn omega_of(&mut self, link: LinkId, tell: bool) -> Result<Amount, Why> {
        if link == LinkId::FRAME {
            return Ok(self.rest());
        }
        let twist = self.twist(link, tell)?;
        Ok(self.board.turning(twist.pole, twist.rate))
    }

    /// The input link and its motion, read off its input.
    fn input_twist(&mut self) -> Result<(LinkId, Twist), Why> {
        let link = driver(self.mechanism).ok_or(NO_INPUT)?;
        let pole = *self.centres.known.get(&chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let rate = match self.mechanism.inputs[0] {
            Input::Angle { omega, .. } => {
                let omega = self.board.amount(omega);
                self.rate_of_turning(link, pole, omega)
            }
            Input::Speed { point, speed, .. } => {
                let first = self.mechanism.link(link).points.first().copied().unwrap_or(point);
                let length = self.length(link, first, point);
                let speed = self.board.amount(speed);
                let reason = self.reason(&[link]);
                let omega = self.board.quotient(speed, length, reason);
                self.rate_of_turning(link, pole, omega)
            }
            Input::Slide { slide, velocity, .. } => {
                let rider = self.riding_point(slide, PointId(0));
                let (along, _) = self.tangent(slide, rider);
                let speed = self.board.amount(velocity);
                let velocity = self.board.components(along, speed);
                let (at, scale) = (self.at(rider), self.length_scale());
                let reason = self.reason(&[link]);
                self.board.rate_about(pole, at, velocity, scale, reason)
            }
        };
        Ok((link, Twist { pole, rate }))
    }

    /// The rate of a link about its pole that turns it with ω.
    fn rate_of_turning(&mut self, link: LinkId, pole: HomogeneousPoint, omega: Amount) -> Amount {
        let reason = self.reason(&[link]);
        self.board.rate_of(pole, omega, reason)
    }

    /// The motion of a link, by the centre that it has with the input link.
    fn twist(&mut self, link: LinkId, tell: bool) -> Result<Twist, Why> {
        let (input, driving) = self.input_twist()?;
        if link == input {
            return Ok(driving);
        }
        let known = |d: &Self, c| d.centres.known.get(&c).copied();
        let pole = known(self, chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let common = known(self, chord(input, link)).ok_or(NO_POLE)?;
        let reason = self.reason(&[input, link]);
        let ratio = self.board.segments(driving.pole, pole, common, reason).ok_or(COINCIDENT)?;
        let rate = self.board.part_of(driving.rate, ratio);
        let twist = Twist { pole, rate };
        if tell {
            let places = [driving.pole, pole, common].map(|p| self.board.locate(p, reason));
            let omegas = [driving, twist].map(|t| self.board.turning(t.pole, t.rate).value());
            if let [Location::At(first), Location::At(second), Location::At(common)] = places {
                let mm = [first, second].map(|p| self.board.distance(p, common).value());
                self.tell(TransferAct::Ratio { input, link, mm, omegas });
                self.draw_transfer(TransferInk::LineOfCentres { from: first.value(), to: common.value() });
                self.draw_transfer(TransferInk::LineOfCentres { from: second.value(), to: common.value() });
            } else if let [Location::At(first), Location::Toward(..), Location::At(common)] = places {
                let mm = self.board.distance(first, common).value();
                let speed = mm * self.scales.length() * omegas[0].abs();
                self.tell(TransferAct::CommonSpeed {
                    links: [input, link],
                    of: input,
                    mm,
                    omega: omegas[0],
                    speed,
                });
                self.draw_transfer(TransferInk::LineOfCentres { from: first.value(), to: common.value() });
            }
        }
        Ok(twist)
    }

    // --- line of centres and gauge line --------------------------------------------------------

    /// V of the transfer centre, laid off on the line of centres, and the gauge line from the pole.
    fn by_line_of_centres(&mut self, quantity: Quantity) -> Result<FromCentres, Why> {
        let (point, link) = self.target(quantity, transfer_home)?;
        let (input, driving) = self.input_twist()?;
        let reason = self.reason(&[input, link]);
        if link == input {
            return self.of_input(point, link);
        }
        let known = |d: &Self, c| d.centres.known.get(&c).copied();
        let pole = known(self, chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let common = known(self, chord(input, link)).ok_or(NO_POLE)?;
        let [Location::At(first), pole, Location::At(transfer)] =
            [driving.pole, pole, common].map(|p| self.board.locate(p, reason))
        else {
            return Err(OFF_SHEET);
        };
        self.draw_transfer(TransferInk::LineOfCentres { from: first.value(), to: transfer.value() });
        // V of the transfer centre as a point of the input link.
        let omega = self.board.turning(driving.pole, driving.rate);
        let (scale, paper) = (self.length_scale(), self.polygon_scale(Order::Velocity));
        let (out, arm) = self.board.toward(first, transfer, reason);
        let length = self.board.read(arm, scale);
        let speed = self.board.product(omega, length);
        self.tell(TransferAct::CommonSpeed {
            links: [input, link],
            of: input,
            mm: arm.value(),
            omega: omega.value(),
            speed: speed.value().abs(),
        });
        let square = self.board.quarter_turn(out);
        let mm = self.board.to_paper(speed, paper);
        let tip = self.board.lay_off(transfer, square, mm);
        let spot = Spot::Centre(chord(input, link));
        self.draw_transfer(TransferInk::Velocity { at: transfer.value(), tip: tip.value(), of: spot });
        let second = match pole {
            Location::At(second) => second,
            Location::Toward(..) => {
                // All points of the link have this velocity.
                self.tell(TransferAct::Translation { link, speed: speed.value().abs() });
                let velocity = self.arrow(transfer, tip, paper);
                return Ok(self.of_translation(point, velocity));
            }
        };
        self.draw_transfer(TransferInk::LineOfCentres { from: second.value(), to: transfer.value() });
        // The same arrow seen from the other pole.
        let (away, _) = self.board.toward(second, transfer, reason);
        let back = self.board.quarter_turn(away);
        let [along, _] = self.board.square_off(Line { through: transfer, along: back }, tip);
        match point {
            Some(point) => {
                let velocity = self.on_gauge(second, (transfer, along, spot), point, reason);
                Ok(FromCentres::Vector(velocity))
            }
            None => {
                let (_, radius) = self.board.toward(second, transfer, reason);
                Ok(FromCentres::Scalar(self.omega_by(link, spot, along, radius)))
            }
        }
    }

    /// What is asked of the input link itself: no centre has to be changed.
    fn of_input(&mut self, point: Option<PointId>, link: LinkId) -> Result<FromCentres, Why> {
        match point {
            Some(point) => self.velocity_of_point(point, link, true).map(FromCentres::Vector),
            None => self.omega_of(link, true).map(FromCentres::Scalar),
        }
    }

    /// What is asked of a link that does not turn.
    fn of_translation(&mut self, point: Option<PointId>, velocity: [Amount; 2]) -> FromCentres {
        match point {
            Some(point) => {
                let at = self.at(point);
                self.draw_velocity(Spot::Point(point), at, velocity);
                FromCentres::Vector(velocity)
            }
            None => FromCentres::Scalar(self.rest()),
        }
    }

    /// ω = V / (1k–P), with the sense that the arrow shows.
    fn omega_by(&mut self, link: LinkId, spot: Spot, along: Mm, radius: Mm) -> Amount {
        let (scale, paper) = (self.length_scale(), self.polygon_scale(Order::Velocity));
        let reason = self.reason(&[link]);
        let (speed, length) = (self.board.read(along, paper), self.board.read(radius, scale));
        let omega = self.board.quotient(speed, length, reason);
        self.tell(TransferAct::Omega {
            link,
            spot,
            mm: radius.value(),
            speed: speed.value().abs(),
            omega: omega.value(),
        });
        omega
    }

    /// V of a point by the gauge line: from the pole through the tip of a known velocity, which stands square to its
    /// radius; the point is turned about the pole onto that radius.
    fn on_gauge(
        &mut self,
        pole: Point,
        (from, along, spot): (Point, Mm, Spot),
        point: PointId,
        reason: u32,
    ) -> [Amount; 2] {
        let paper = self.polygon_scale(Order::Velocity);
        let at = self.at(point);
        let (away, _) = self.board.toward(pole, from, reason);
        let square = self.board.quarter_turn(away);
        let tip = self.board.lay_off(from, square, along);
        let (out, radius) = self.board.toward(pole, at, reason);
        let turned = self.board.lay_off(pole, away, radius);
        let (gauge, _) = self.board.toward(pole, tip, reason);
        let upright = Line { through: turned, along: square };
        let meet = self.board.meet_lines(Line { through: pole, along: gauge }, upright, reason);
        let mm = meet.along[1];
        let [foot, end] = farther(pole, [from, tip], [turned, meet.at]).map(|at| at.value());
        self.draw_transfer(TransferInk::Gauge { from: pole.value(), to: end, foot });
        self.draw_transfer(TransferInk::Arc { centre: pole.value(), from: at.value(), to: turned.value() });
        self.draw_transfer(TransferInk::Upright { from: turned.value(), to: meet.at.value() });
        let back = self.board.quarter_turn(out);
        let head = self.board.lay_off(at, back, mm);
        self.draw_transfer(TransferInk::Velocity {
            at: at.value(),
            tip: head.value(),
            of: Spot::Point(point),
        });
        let velocity = self.arrow(at, head, paper);
        let speed = libm::hypot(velocity[0].value(), velocity[1].value());
        self.tell(TransferAct::Gauge { from: spot, point, mm: mm.value().abs(), speed });
        velocity
    }

    /// An arrow of the skeleton read as a velocity.
    fn arrow(&mut self, from: Point, to: Point, paper: Scale) -> [Amount; 2] {
        self.board.between(from, to).map(|mm| self.board.read(mm, paper))
    }

    // --- from pin to pin -----------------------------------------------------------------------

    /// From the input link along a chain of pins, by gauge lines or by parallels to the links.
    fn by_chain(&mut self, quantity: Quantity, method: Method) -> Result<FromCentres, Why> {
        let (point, link) = self.target(quantity, home)?;
        let (input, driving) = self.input_twist()?;
        if link == input {
            return self.of_input(point, link);
        }
        let hops = chain(self.mechanism, input, link).ok_or(NO_CHAIN)?;
        let Some(&(_, first)) = hops.first() else { return Err(NO_CHAIN) };
        let (scale, paper) = (self.length_scale(), self.polygon_scale(Order::Velocity));
        let start = self.at(first);
        let mut velocity = self.board.velocity_about(driving.pole, driving.rate, start, scale);
        self.draw_velocity(Spot::Point(first), start, velocity);
        let speed = libm::hypot(velocity[0].value(), velocity[1].value());
        let reason = self.reason(&[input]);
        if let Location::At(pole) = self.board.locate(driving.pole, reason) {
            let (mm, omega) =
                (self.board.distance(pole, start).value(), self.board.turning(driving.pole, driving.rate));
            self.tell(TransferAct::AboutPole { link: input, point: first, mm, omega: omega.value(), speed });
        }
        for (n, &(on, pin)) in hops.iter().enumerate() {
            let next = hops.get(n + 1).map(|(_, p)| *p);
            let last = next.is_none();
            let to = match (next, point) {
                (Some(next), _) => Some(next),
                (None, Some(point)) if point != pin => Some(point),
                (None, Some(_)) => None,
                // For ω any other point of the link will do.
                (None, None) => self.other_point(on, pin),
            };
            let Some(to) = to else {
                return match point {
                    Some(_) => Ok(FromCentres::Vector(velocity)),
                    None => self.of_single_point(on, pin, velocity),
                };
            };
            let from = self.at(pin);
            let tip = self.tip(from, velocity, paper);
            let omega_too = last && point.is_none();
            let moved = match method {
                Method::LinkToLink => self.by_parallel(on, (pin, from, tip), to, omega_too)?,
                _ => self.by_gauge(on, (pin, from, tip), to, omega_too)?,
            };
            match moved {
                FromCentres::Vector(next) => velocity = next,
                scalar @ FromCentres::Scalar(_) => return Ok(scalar),
            }
        }
        Ok(FromCentres::Vector(velocity))
    }

    /// ω of a link with one point, from that point's velocity.
    fn of_single_point(
        &mut self,
        link: LinkId,
        pin: PointId,
        velocity: [Amount; 2],
    ) -> Result<FromCentres, Why> {
        let pole = *self.centres.known.get(&chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let (at, scale) = (self.at(pin), self.length_scale());
        let reason = self.reason(&[link]);
        let rate = self.board.rate_about(pole, at, velocity, scale, reason);
        Ok(FromCentres::Scalar(self.board.turning(pole, rate)))
    }

    /// The tip of a velocity's arrow at its point.
    fn tip(&mut self, at: Point, velocity: [Amount; 2], paper: Scale) -> Point {
        let [x, y] = velocity.map(|v| self.board.to_paper(v, paper));
        self.board.moved(at, [x, y])
    }

    /// A point of a link other than this one, a moving one first: the link's fixed pivot has no arrow.
    fn other_point(&self, link: LinkId, but: PointId) -> Option<PointId> {
        let others = || self.mechanism.link(link).points.iter().copied().filter(move |&p| p != but);
        others()
            .find(|&p| !self.mechanism.is_fixed(p) && self.places[p.0].is_some())
            .or_else(|| others().next())
    }

    /// One hop by the gauge line of a link.
    fn by_gauge(
        &mut self,
        link: LinkId,
        (pin, from, tip): (PointId, Point, Point),
        to: PointId,
        omega_too: bool,
    ) -> Result<FromCentres, Why> {
        let reason = self.reason(&[link]);
        let pole = *self.centres.known.get(&chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let paper = self.polygon_scale(Order::Velocity);
        match self.board.locate(pole, reason) {
            Location::Toward(..) => {
                let velocity = self.arrow(from, tip, paper);
                let speed = libm::hypot(velocity[0].value(), velocity[1].value());
                self.tell(TransferAct::Translation { link, speed });
                Ok(self.of_translation((!omega_too).then_some(to), velocity))
            }
            Location::At(pole) => {
                let (away, radius) = self.board.toward(pole, from, reason);
                let square = self.board.quarter_turn(away);
                let [along, _] = self.board.square_off(Line { through: from, along: square }, tip);
                if omega_too {
                    // Its slope is ω.
                    let [from, to] = [from, tip].map(|at| at.value());
                    self.draw_transfer(TransferInk::Gauge { from: pole.value(), to, foot: from });
                    return Ok(FromCentres::Scalar(self.omega_by(link, Spot::Point(pin), along, radius)));
                }
                let velocity = self.on_gauge(pole, (from, along, Spot::Point(pin)), to, reason);
                Ok(FromCentres::Vector(velocity))
            }
        }
    }

    /// One hop by a parallel to the link: A′ on the line from A to the pole, A′B′ ∥ AB, B′ on the line from B to the
    /// pole; BB′ is V of B, turned.
    fn by_parallel(
        &mut self,
        link: LinkId,
        (pin, from, tip): (PointId, Point, Point),
        to: PointId,
        omega_too: bool,
    ) -> Result<FromCentres, Why> {
        let reason = self.reason(&[link]);
        let pole = *self.centres.known.get(&chord(LinkId::FRAME, link)).ok_or(NO_POLE)?;
        let (scale, paper) = (self.length_scale(), self.polygon_scale(Order::Velocity));
        let at = self.at(to);
        // Turned by 90° clockwise, so that for a positive ω the turned arrow points away from the pole.
        let turned = self.board.turned_about(from, tip);
        self.draw_transfer(TransferInk::Turned { at: from.value(), tip: turned.value(), of: pin });
        let (link_line, length) = self.board.toward(from, at, reason);
        let toward_pole = self.board.direction_to(at, pole, reason);
        let parallel = Line { through: turned, along: link_line };
        let meet = self.board.meet_lines(parallel, Line { through: at, along: toward_pole }, reason);
        let flat = libm::sin(meet.crossing) < FLATTEST_CROSSING;
        let found = if flat {
            // A, B and the pole in one line: the parallel falls on it. V is in proportion to the distance from
            // the pole.
            let velocity = self.arrow(from, tip, paper);
            let rate = self.board.rate_about(pole, from, velocity, scale, reason);
            let velocity = self.board.velocity_about(pole, rate, at, scale);
            let head = self.tip(at, velocity, paper);
            self.board.turned_about(at, head)
        } else {
            let link = [from, at].map(|end| end.value());
            self.draw_transfer(TransferInk::Parallel { from: turned.value(), to: meet.at.value(), link });
            meet.at
        };
        self.draw_transfer(TransferInk::ToPole { from: at.value(), to: found.value() });
        self.draw_transfer(TransferInk::Turned { at: at.value(), tip: found.value(), of: to });
        if omega_too {
            // A′B′ : AB = 1 + ω (length scale / velocity scale).
            let [drawn, _] = self.board.square_off(Line { through: turned, along: link_line }, found);
            let longer = self.board.less(drawn, length);
            let (speed, own) = (self.board.read(longer, paper), self.board.read(length, scale));
            let omega = self.board.quotient(speed, own, reason);
            let mm = [drawn.value(), length.value()];
            self.tell(TransferAct::OmegaByParallel { link, from: pin, to, flat, mm, omega: omega.value() });
            return Ok(FromCentres::Scalar(omega));
        }
        let head = self.board.turned_back(at, found);
        self.draw_transfer(TransferInk::Velocity { at: at.value(), tip: head.value(), of: Spot::Point(to) });
        let velocity = self.arrow(at, head, paper);
        let speed = libm::hypot(velocity[0].value(), velocity[1].value());
        let mm = self.board.distance(at, found).value();
        self.tell(TransferAct::Parallel { link, from: pin, to, flat, mm, speed });
        Ok(FromCentres::Vector(velocity))
    }

    /// The point and the link that a transfer leads to; no point for an angular velocity.
    fn target(
        &self,
        quantity: Quantity,
        home: fn(&Mechanism, &Structure, PointId) -> Option<LinkId>,
    ) -> Result<(Option<PointId>, LinkId), Why> {
        match quantity {
            Quantity::Velocity(p) => {
                let link = home(self.mechanism, self.structure, p).ok_or("a fixed point has no velocity")?;
                Ok((Some(p), link))
            }
            Quantity::Omega(l) => Ok((None, l)),
            _ => Err("this method leads to v(B) and omega(3) only"),
        }
    }

    // --- the record ----------------------------------------------------------------------------

    fn draw_velocity(&mut self, of: Spot, at: Point, velocity: [Amount; 2]) {
        let paper = self.polygon_scale(Order::Velocity);
        let tip = self.tip(at, velocity, paper);
        self.draw_transfer(TransferInk::Velocity { at: at.value(), tip: tip.value(), of });
    }

    fn tell(&mut self, act: TransferAct) {
        if let Some(transfer) = self.transfer_mut() {
            transfer.acts.push(act);
        }
    }

    fn draw_transfer(&mut self, ink: TransferInk) {
        if let Some(transfer) = self.transfer_mut() {
            transfer.ink.push(ink);
        }
    }

    /// Begins the record of a transfer.
    pub(in super::super) fn open_transfer(&mut self, asked: usize, method: Method) {
        let si_per_mm = self.polygon_scale(Order::Velocity).si_per_mm;
        if let Some(transfers) = self.transfers_mut() {
            transfers.push(Transfer { asked, method, si_per_mm, acts: Vec::new(), ink: Vec::new() });
        }
    }
}

/// A velocity, or an angular velocity, found from centres.
pub(in super::super) enum FromCentres {
    /// A velocity.
    Vector([Amount; 2]),
    /// An angular velocity.
    Scalar(Amount),
}

/// The farther of two points from a third.
fn farther(from: Point, one: [Point; 2], other: [Point; 2]) -> [Point; 2] {
    let away = |[_, tip]: &[Point; 2]| {
        let (a, b) = (from.value(), tip.value());
        libm::hypot(b[0] - a[0], b[1] - a[1])
    };
    if away(&one) >= away(&other) { one } else { other }
}
