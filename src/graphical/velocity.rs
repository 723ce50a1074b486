//! The velocity polygon, link by link (`s000-ch3a` 2.1 and 2.3).
//!
//! 1. Take a pole o: it represents every point of the fixed plane.
//! 2. Lay off V of a driven point: V = ω l, perpendicular to the link, in the sense of ω.
//! 3. From the image of each known point a line perpendicular to the link (or, for a slider, from the pole
//!    a line parallel to the guide). They meet in the image of the pin.
//! 4. Read V and divide by the length: ω = V / l, with the sense that the vector shows.
//!    A pin on the guide of a moving link has a point of that link under it (`s000-ch3a` 2.4): from the
//!    image of that point a line parallel to the guide; and backwards from the pin's image where the lever
//!    is sought. What is read along it is the sliding velocity.
//! 5. Further points: divide the image line as the link is divided, or from two images perpendiculars to
//!    the sides; the image has the link's own reading sense.

use crate::board::{Amount, Direction, Line, Mm, Point, Ratio};
use crate::given::Given;
use crate::mechanism::quantity::{Dimension, Order, Quantity};
use crate::mechanism::structure::{Drive, Group, GroupKind, Target, TrialDriver, Unknown};
use crate::mechanism::{Input, LinkId, Path, PointId, Rider, Roll};
use crate::plan::{GroupStep, Plan};

use super::construction::{Act, Calculation, Claim, Label, Reference, Vector, VectorKind};
use super::draughtsman::Draughtsman;
use super::dyad::Route;
use super::missing::Missing;

/// Two sides of an image triangle that cross flatter than this are not constructed from but replaced by
/// the similar figure (sine of about 3°, `drawing.md`).
pub(super) const FLATTEST_CROSSING: f64 = 0.05;

/// Draws the steps of the velocity polygon.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) {
    d.open_polygon(Order::Velocity);
    let rest = d.rest();
    d.set_rate(Order::Velocity, LinkId::FRAME, rest);
    d.step(Order::Velocity, &[], Vec::new());
    d.act(Act::MarkPole);
    for step in plan.steps(Order::Velocity) {
        d.velocity_of(step, &d.structure.groups[step.group]);
    }
}

impl Draughtsman<'_> {
    /// Draws the velocity polygon of one group.
    pub(super) fn velocity_of(&mut self, step: &GroupStep, group: &Group) {
        match group.kind {
            GroupKind::Driver { base, input } => match input {
                Drive::Input(input) => self.velocity_of_driver(step, group.links[0], base, input),
                Drive::Trial(_) | Drive::With(_) => {
                    let omega = self.driven_rate(Order::Velocity, input);
                    self.set_rate(Order::Velocity, group.links[0], omega);
                    self.step(Order::Velocity, &group.links, Vec::new());
                    self.driven_velocities(step, group.links[0], base);
                }
            },
            GroupKind::DrivenSlide { slide, input } => self.velocity_of_slide(step, group, slide, input),
            GroupKind::Wheel { wheel, centre, roll } => self.velocity_of_wheel(step, wheel, centre, roll),
            GroupKind::Planet { .. } => self.velocity_of_planet(step, group.kind),
            GroupKind::DrivenWheel { .. } => self.velocity_of_driven_wheel(step, group.kind),
            GroupKind::DrivenRack { .. } => self.velocity_of_driven_rack(step, group.kind),
            GroupKind::DrivenBar { link, input, .. } => {
                let omega = self.driven_rate(Order::Velocity, input);
                self.set_rate(Order::Velocity, link, omega);
                self.dyad(Order::Velocity, step, group);
            }
            GroupKind::Higher { trial } => self.polygon_by_trial(Order::Velocity, step, trial),
            _ => self.dyad(Order::Velocity, step, group),
        }
        self.rates_of_blocks(Order::Velocity, &group.links);
        for &link in &group.links {
            self.note_link_image(Order::Velocity, link);
        }
    }

    /// Zero, exact.
    pub(super) fn rest(&mut self) -> Amount {
        self.board.amount(crate::given::Given::exact(0.0))
    }

    /// V_B or V_BA, as the reference moves or not.
    pub(super) fn relative_velocity(&self, point: PointId, base: PointId) -> Quantity {
        if self.mechanism.is_fixed(base) {
            Quantity::Velocity(point)
        } else {
            Quantity::RelativeVelocity(point, base)
        }
    }

    /// Thick vectors from the pole are absolute, the others relative.
    pub(super) fn kind_of(&self, base: PointId) -> VectorKind {
        if self.mechanism.is_fixed(base) { VectorKind::Absolute } else { VectorKind::Relative }
    }

    /// V = ω l, laid off perpendicular to the link in the sense of ω.
    fn velocity_of_driver(&mut self, step: &GroupStep, link: LinkId, base: PointId, input: usize) {
        self.board.purpose("velocity of a driven point");
        self.step(Order::Velocity, &[link], Vec::new());
        let omega = self.given_rate(Order::Velocity, input);
        let omega = self.rate_as_calculated(Order::Velocity, link, omega);
        self.set_rate(Order::Velocity, link, omega);
        self.driven_velocities(step, link, base);
    }

    /// ω or ε of a driven link, or the rate of a driven slide: given, or tried.
    pub(super) fn driven_rate(&mut self, order: Order, input: Drive) -> Amount {
        match input {
            Drive::Input(index) => match (self.mechanism.inputs[index], order) {
                (Input::Slide { acceleration, .. }, Order::Acceleration) => self.board.amount(acceleration),
                (Input::Slide { velocity, .. }, _) => self.input_rate(index, velocity),
                _ => self.given_rate(order, index),
            },
            Drive::Trial(driver) => {
                let tried = self.tried_rates.iter().rev();
                let mut tried = tried.filter(|(of, tried, _)| (*of, *tried) == (order, driver));
                match tried.next() {
                    Some(&(.., rate)) => rate,
                    None => self.no_amount(Missing::rate_of(order, driver)),
                }
            }
            Drive::With(link) => self.known_rate(order, link),
        }
    }

    /// ω or ε of a link that is solved, driven or tried, whose own group may be drawn later.
    fn known_rate(&mut self, order: Order, link: LinkId) -> Amount {
        let tried = TrialDriver::Turn(link);
        if self.tried_rates.iter().any(|&(of, driver, _)| (of, driver) == (order, tried)) {
            return self.driven_rate(order, Drive::Trial(tried));
        }
        let driven = self.mechanism.inputs.iter().position(|input| {
            matches!(*input, Input::Angle { link: of, .. } | Input::Speed { link: of, .. } if of == link)
        });
        match driven {
            Some(input) => self.given_rate(order, input),
            None => self.rate(order, link),
        }
    }

    /// The rate that an input gives, or the one that is assumed of a mechanism at rest.
    fn input_rate(&mut self, input: usize, given: Given) -> Amount {
        match self.assumed_rate {
            Some(assumed) => self.board.amount(assumed),
            None => self.board.input_speed(input, given),
        }
    }

    /// ω or ε of a driven link; ω from the speed of one of its points where that is given.
    pub(super) fn given_rate(&mut self, order: Order, input: usize) -> Amount {
        let rate = match (self.mechanism.inputs[input], order) {
            (Input::Angle { alpha, .. } | Input::Speed { alpha, .. }, Order::Acceleration) => alpha,
            (Input::Angle { omega, .. }, _) => return self.input_rate(input, omega),
            (Input::Speed { link, point, speed, .. }, _) => {
                let Some(&first) = self.mechanism.link(link).points.first() else {
                    return self.no_amount(Missing::Rate(order, link));
                };
                let length = self.length(link, first, point);
                let speed = self.board.amount(self.assumed_rate.unwrap_or(speed));
                let reason = self.reason(&[link]);
                let omega = self.board.quotient(speed, length, reason);
                self.act(Act::Calculate(Calculation::Omega {
                    link,
                    quantity: self.relative_velocity(point, first),
                    ends: [first, point],
                    speed: speed.value().abs(),
                    length: length.value(),
                    value: omega.value(),
                }));
                return omega;
            }
            // A driven slide says nothing of a link's rotation.
            (Input::Slide { slide, .. }, _) => {
                let link = self.mechanism.slides[slide].guide.link;
                return self.no_amount(Missing::Rate(order, link));
            }
        };
        self.board.amount(rate)
    }

    /// V = ω l of each wanted point of a link whose ω is known, about its base.
    pub(super) fn driven_velocities(&mut self, step: &GroupStep, link: LinkId, base: PointId) {
        for &(_, point) in &step.points {
            let begins = self.acts();
            let as_one = self.image_as_one(Order::Velocity, link, base, point);
            let image = as_one.unwrap_or_else(|| self.turned_about(link, base, point));
            let image = self.note_image(Order::Velocity, point, image);
            if as_one.is_none() {
                self.note_turned(link, base, point, image);
                self.tell_turned(Order::Velocity, link, (base, point), begins);
            }
            if !self.mechanism.is_fixed(base) {
                let label = self.label(point);
                self.absolute_vector(Order::Velocity, Quantity::Velocity(point), label, image);
            }
        }
    }

    /// The direction from `base` to `point` on the skeleton, turned by +90°: that of the velocity of
    /// `point` for a positive ω.
    pub(super) fn square_to(&mut self, link: LinkId, base: PointId, point: PointId) -> Direction {
        let along = self.outward(link, base, point);
        self.board.quarter_turn(along)
    }

    /// The direction from `base` to `point` on the skeleton.
    pub(super) fn outward(&mut self, link: LinkId, base: PointId, point: PointId) -> Direction {
        let (from, to) = (self.at(base), self.at(point));
        let reason = self.reason(&[link]);
        self.board.toward(from, to, reason).0
    }

    /// The given sliding velocity, laid off along the guide from the image of the guide's point.
    fn velocity_of_slide(&mut self, step: &GroupStep, group: &Group, slide: usize, input: Drive) {
        let (rider, guide) = (self.mechanism.slides[slide].rider, self.mechanism.slides[slide].guide.link);
        let first = self.riding_point(slide, PointId(0));
        self.board.purpose("velocity of a driven slide");
        self.step(Order::Velocity, &group.links, Vec::new());
        let (along, _) = self.tangent(slide, first);
        let scale = self.polygon_scale(Order::Velocity);
        let speed = self.driven_rate(Order::Velocity, input);
        let mm = self.board.to_paper(speed, scale);
        let from = self.image_under(Order::Velocity, first, guide);
        let fixed = guide == LinkId::FRAME;
        let (kind, quantity) = if fixed {
            (VectorKind::Absolute, Quantity::Velocity(first))
        } else {
            (VectorKind::Sliding, Quantity::Slip(first, guide))
        };
        let image = self.lay_off_vector(quantity, from, along, mm);
        self.motion_mut(Order::Velocity).slidings[slide] = Some(speed);
        let image = self.note_image(Order::Velocity, first, image);
        let claim = Claim::Parallel(Reference::Guide(slide));
        let (tail, head) = ((self.label_under(first, guide), from), (self.label(first), image));
        let vector = self.note_vector(Order::Velocity, (kind, quantity, Some(claim)), tail, head);
        self.act(Act::LayOffVector { vector, value: speed.value().abs(), mm: mm.value().abs() });
        self.note_part(Quantity::Slip(first, guide), from, image);
        if !fixed {
            let under = self.found_under(Order::Velocity, first, guide);
            self.known_sum(Order::Velocity, (first, under), &[(quantity, claim)], 0);
            let label = self.label(first);
            self.absolute_vector(Order::Velocity, Quantity::Velocity(first), label, image);
        }
        if let Rider::Link { link, .. } = rider {
            let rate = self.rate(Order::Velocity, guide);
            self.set_rate(Order::Velocity, link, rate);
            self.riding_points(Order::Velocity, step, link, first);
        }
    }

    /// Images of the further points of a driven link that slides without turning.
    pub(super) fn riding_points(&mut self, order: Order, step: &GroupStep, link: LinkId, first: PointId) {
        for &(of, point) in &step.points {
            if of != link || point == first {
                continue;
            }
            let image = self.riding_image(order, link, first, point);
            let image = self.note_image(order, point, image);
            let label = self.label(point);
            let quantity = match order {
                Order::Acceleration => Quantity::Acceleration(point),
                _ => Quantity::Velocity(point),
            };
            self.absolute_vector(order, quantity, label, image);
        }
    }

    /// The contact points of both bodies have one velocity; ω of the wheel is that velocity, seen from its
    /// centre, over its radius.
    fn velocity_of_wheel(&mut self, step: &GroupStep, wheel: LinkId, centre: PointId, roll: usize) {
        self.board.purpose("velocity of a contact point");
        self.step(Order::Velocity, &[wheel], Vec::new());
        self.contact_without_slip(wheel, roll);
        self.spin_from_contact(wheel, centre, roll);
        self.points_of_wheel(Order::Velocity, step, wheel, centre);
    }

    /// The contact points of both bodies have one velocity.
    fn contact_without_slip(&mut self, wheel: LinkId, roll: usize) -> (Label, Point) {
        let contact = self.contact_of(roll);
        let other = self.rolled_on(roll, wheel);
        let image = self.contact_image(Order::Velocity, roll, other);
        let image = self.note_under(Order::Velocity, contact, wheel, image);
        let labels = (self.label_under(contact, wheel), self.label_under(contact, other));
        self.act(Act::SameImage { label: labels.0, with: labels.1 });
        (labels.0, image)
    }

    /// ω of a wheel: the velocity of its contact point, seen from its centre, over its radius.
    fn spin_from_contact(&mut self, wheel: LinkId, centre: PointId, roll: usize) {
        let contact = self.contact_of(roll);
        let image = self.contact_image(Order::Velocity, roll, wheel);
        let from = self.image(Order::Velocity, centre);
        let quantity = Quantity::CoincidentVelocity(contact, wheel);
        let claim = Claim::Perpendicular(Reference::Points(centre, contact));
        let vector = self.note_vector(
            Order::Velocity,
            (self.kind_of(centre), quantity, Some(claim)),
            (self.label(centre), from),
            (self.label_under(contact, wheel), image),
        );
        self.act_read(Order::Velocity, vector);
        let square = self.square_to(wheel, centre, contact);
        let [along, _] = self.board.square_off(Line { through: from, along: square }, image);
        let scale = self.polygon_scale(Order::Velocity);
        let speed = self.board.read(along, scale);
        let speed = self.as_read(quantity, speed);
        let radius = self.length_to(wheel, centre, contact);
        let reason = self.reason(&[wheel]);
        let omega = self.board.quotient(speed, radius, reason);
        let omega = self.rate_as_calculated(Order::Velocity, wheel, omega);
        self.set_rate(Order::Velocity, wheel, omega);
        self.act(Act::Calculate(Calculation::Omega {
            link: wheel,
            quantity,
            ends: [centre, contact],
            speed: speed.value().abs(),
            length: radius.value(),
            value: omega.value(),
        }));
    }

    /// The velocities of both contact points of a planet are known: its centre divides the line between their images as it
    /// divides that between them. ω of the arm, then that of the planet.
    fn velocity_of_planet(&mut self, step: &GroupStep, kind: GroupKind) {
        let GroupKind::Planet { arm, base, wheel, centre, rolls } = kind else { return };
        let order = Order::Velocity;
        self.board.purpose("velocity of a planet's centre");
        self.step(order, &[arm, wheel], Vec::new());
        let [first, second] = rolls.map(|roll| self.contact_without_slip(wheel, roll));
        let ratio = self.ratio_of_contacts((wheel, centre), rolls);
        let at = self.board.divide(first.1, second.1, ratio);
        let at = self.note_image(order, centre, at);
        let head = (self.label(centre), at);
        self.act(Act::DivideImage { label: head.0, from: first.0, to: second.0, ratio: ratio.value() });
        let (from, along) = (self.image(order, base), self.square_to(arm, base, centre));
        let claim = Claim::Perpendicular(Reference::Points(base, centre));
        let (foot, unknown) = ((self.label(base), from), Unknown::Turn { link: arm, base, to: centre });
        let route = Route { foot, ray: Line { through: from, along }, claim, unknown };
        let [along, _] = self.board.square_off(route.ray, at);
        self.read_omega(&route, Target::Pin(centre), (arm, base), head, along);
        self.absolute_of(order, centre, at);
        self.spin_from_contact(wheel, centre, rolls[0]);
        self.points_of_wheel(order, step, wheel, centre);
        self.further_images(order, step, kind);
    }

    /// How the centre of a planet divides the line between its contact points, from the first one.
    pub(super) fn ratio_of_contacts(
        &mut self,
        (wheel, centre): (LinkId, PointId),
        rolls: [usize; 2],
    ) -> Ratio {
        let [from, to] = rolls.map(|roll| self.contact_of(roll));
        let (through, middle, end) = (self.at(from), self.at(centre), self.at(to));
        let along = self.outward(wheel, centre, from);
        let line = Line { through, along };
        let [part, _] = self.board.square_off(line, middle);
        let [whole, _] = self.board.square_off(line, end);
        let reason = self.reason(&[wheel]);
        self.board.ratio(part, whole, reason)
    }

    /// Images of the further points of a wheel, about its centre.
    pub(super) fn points_of_wheel(&mut self, order: Order, step: &GroupStep, wheel: LinkId, centre: PointId) {
        for &(of, point) in &step.points {
            if of == wheel {
                let image = self.image_about_told(order, wheel, centre, point);
                let image = self.note_image(order, point, image);
                self.absolute_of(order, point, image);
            }
        }
    }

    /// The contact points of both bodies have one velocity; from its image V = ω r of the driven wheel's
    /// centre against it.
    fn velocity_of_driven_wheel(&mut self, step: &GroupStep, kind: GroupKind) {
        let GroupKind::DrivenWheel { wheel, centre, roll, input, .. } = kind else { return };
        let contact = self.contact_of(roll);
        self.board.purpose("velocity of a driven wheel");
        self.step(Order::Velocity, &[wheel], Vec::new());
        let omega = self.driven_rate(Order::Velocity, input);
        self.set_rate(Order::Velocity, wheel, omega);
        let other = self.rolled_on(roll, wheel);
        let image = self.contact_image(Order::Velocity, roll, other);
        self.note_under(Order::Velocity, contact, wheel, image);
        let with = self.label_under(contact, other);
        self.act(Act::SameImage { label: self.label_under(contact, wheel), with });
        let head = self.label(centre);
        let at = self.spin_part(Order::Velocity, roll, (wheel, centre), head);
        let at = self.note_image(Order::Velocity, centre, at);
        if other != LinkId::FRAME {
            self.absolute_vector(Order::Velocity, Quantity::Velocity(centre), head, at);
        }
        // How fast the centre runs along what holds it shows in the same figure.
        if let Some((target, [held, _])) = kind.unknowns(self.mechanism) {
            let loud = !std::mem::replace(&mut self.silent, true);
            self.read_closing(Order::Velocity, held, target, (head, at));
            self.silent = !loud;
        }
        self.points_of_wheel(Order::Velocity, step, wheel, centre);
    }

    /// The contact points of the wheel and of the driven rack have one velocity; from its image V = ω l of each point of
    /// the rack.
    fn velocity_of_driven_rack(&mut self, step: &GroupStep, kind: GroupKind) {
        let GroupKind::DrivenRack { link, wheel, roll, input, .. } = kind else { return };
        let contact = self.contact_of(roll);
        self.board.purpose("velocity of a driven rack");
        self.step(Order::Velocity, &[link], Vec::new());
        let omega = self.driven_rate(Order::Velocity, input);
        self.set_rate(Order::Velocity, link, omega);
        let image = self.contact_image(Order::Velocity, roll, wheel);
        self.note_under(Order::Velocity, contact, link, image);
        let with = self.label_under(contact, wheel);
        self.act(Act::SameImage { label: self.label_under(contact, link), with });
        self.other_pins(Order::Velocity, kind);
        self.further_images(Order::Velocity, step, kind);
    }

    /// The body on which a wheel rolls.
    pub(super) fn rolled_on(&self, roll: usize, wheel: LinkId) -> LinkId {
        match self.mechanism.rolls[roll] {
            Roll::Circles { links: [a, b], .. } => {
                if a == wheel {
                    b
                } else {
                    a
                }
            }
            Roll::Line { guide, wheel: own, .. } => {
                if own == wheel {
                    guide.link
                } else {
                    own
                }
            }
        }
    }

    /// The image of the contact point as a point of a solved body: about its own centre where it is a wheel.
    pub(super) fn contact_image(&mut self, order: Order, roll: usize, body: LinkId) -> Point {
        self.image_under(order, self.contact_of(roll), body)
    }

    /// From the image of the base a line perpendicular to the link.
    pub(super) fn velocity_arm(&mut self, link: LinkId, base: PointId, to: PointId) -> Route {
        let image = self.image(Order::Velocity, base);
        let along = self.square_to(link, base, to);
        let claim = Claim::Perpendicular(Reference::Points(base, to));
        self.velocity_ray((self.label(base), image), along, claim, Unknown::Turn { link, base, to })
    }

    /// From the image of the guide's point (or backwards from the rider's) a line along the guide.
    pub(super) fn velocity_slide(&mut self, slide: usize, back: bool, pin: PointId) -> Route {
        let (along, _) = self.tangent(slide, pin);
        let from = self.slide_start(Order::Velocity, (slide, back), pin);
        let claim = Claim::Parallel(Reference::Guide(slide));
        self.velocity_ray(from, along, claim, Unknown::Slide { slide, back })
    }

    fn velocity_ray(
        &mut self,
        foot: (Label, Point),
        along: Direction,
        claim: Claim,
        unknown: Unknown,
    ) -> Route {
        self.act(Act::DrawRay { from: foot.0, claim });
        Route { foot, ray: Line { through: foot.1, along }, claim, unknown }
    }

    /// The point about which a rolling wheel's centre moves, where the other body is a circle.
    pub(super) fn other_centre(&self, roll: usize, wheel: LinkId) -> Option<PointId> {
        match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => Some(centres[usize::from(links[0] == wheel)]),
            Roll::Line { .. } => None,
        }
    }

    /// From the image of the other centre a line perpendicular to the line of centres; on a straight line
    /// from the image of the point under the centre a line along it, or backwards from the centre's.
    pub(super) fn velocity_roll(
        &mut self,
        (roll, wheel, centre): (usize, LinkId, PointId),
        back: bool,
    ) -> Route {
        let unknown = Unknown::Roll { roll, wheel, centre, back };
        let body = self.rolled_on(roll, wheel);
        if back {
            let image = self.image(Order::Velocity, centre);
            let (along, claim) = self.rolling_direction(roll, wheel, centre);
            return self.velocity_ray((self.label(centre), image), along, claim, unknown);
        }
        if let Some(other) = self.other_centre(roll, wheel) {
            let image = self.image(Order::Velocity, other);
            let along = self.square_to(body, other, centre);
            let claim = Claim::Perpendicular(Reference::Points(other, centre));
            return self.velocity_ray((self.label(other), image), along, claim, unknown);
        }
        let image = self.image_under(Order::Velocity, centre, body);
        let (along, claim) = self.rolling_direction(roll, wheel, centre);
        self.velocity_ray((self.label_under(centre, body), image), along, claim, unknown)
    }

    /// Along the line on which a wheel rolls: square to its contact radius.
    pub(super) fn rolling_direction(
        &mut self,
        roll: usize,
        wheel: LinkId,
        centre: PointId,
    ) -> (Direction, Claim) {
        let contact = self.contact_of(roll);
        let along = self.square_to(wheel, centre, contact);
        (along, Claim::Perpendicular(Reference::Points(centre, contact)))
    }

    /// What the unknown part of a rolling wheel's centre is called, seen from where its route begins.
    pub(super) fn rolling_unknown(
        &self,
        order: Order,
        (roll, wheel, centre): (usize, LinkId, PointId),
        foot: Label,
    ) -> (Quantity, VectorKind) {
        if order == Order::Acceleration {
            let kind = if foot == Label::Pole { VectorKind::Absolute } else { VectorKind::Tangential };
            return (self.rolling_tangential(roll, wheel, centre), kind);
        }
        match self.other_centre(roll, wheel) {
            Some(other) => (self.relative_velocity(centre, other), self.kind_of(other)),
            None if self.rolled_on(roll, wheel) == LinkId::FRAME => {
                (Quantity::Velocity(centre), VectorKind::Absolute)
            }
            None => (Quantity::Slip(centre, self.rolled_on(roll, wheel)), VectorKind::Sliding),
        }
    }

    /// What the unknown part along a guide is called, and whether it is drawn backwards along its route. On
    /// the frame it is the rider's own.
    pub(super) fn sliding_unknown(
        &self,
        order: Order,
        target: Target,
        (slide, back): (usize, bool),
    ) -> (Quantity, bool) {
        let guide = self.mechanism.slides[slide].guide;
        let straight = matches!(guide.path, Path::Straight { .. });
        let second = order == Order::Acceleration;
        let rider = self.riding_point(slide, target.pin());
        let grounded = self.solved_side(slide, back) == Some(LinkId::FRAME);
        let quantity = match (target, second) {
            (Target::Pin(pin), false) if grounded => Quantity::Velocity(pin),
            (Target::Under(pin, link), false) if grounded => Quantity::CoincidentVelocity(pin, link),
            (Target::Pin(pin), true) if grounded && straight => Quantity::Acceleration(pin),
            (Target::Under(pin, link), true) if grounded && straight => {
                Quantity::CoincidentAcceleration(pin, link)
            }
            (_, false) => return (Quantity::Slip(rider, guide.link), back),
            (_, true) if straight => return (Quantity::SlipAcceleration(rider, guide.link), back),
            (_, true) => return (Quantity::SlipTangential(rider, guide.link), back),
        };
        (quantity, false)
    }

    /// Reads V along a route and divides by the link's length.
    pub(super) fn read_omega(
        &mut self,
        route: &Route,
        target: Target,
        (link, base): (LinkId, PointId),
        (label, image): (Label, Point),
        along: Mm,
    ) {
        let scale = self.polygon_scale(Order::Velocity);
        let pin = target.pin();
        let quantity = match target {
            Target::Pin(pin) => self.relative_velocity(pin, base),
            Target::Under(pin, link) => Quantity::CoincidentVelocity(pin, link),
        };
        // Behind the velocity with which a pin is driven along its lever it does not start from the pole.
        let kind = match route.unknown {
            Unknown::Reach { .. } => VectorKind::Relative,
            _ => self.kind_of(base),
        };
        let vector = self.note_vector(
            Order::Velocity,
            (kind, quantity, Some(route.claim)),
            route.foot,
            (label, image),
        );
        self.act_read(Order::Velocity, vector);
        let speed = self.board.read(along, scale);
        let speed = self.as_read(quantity, speed);
        let length = self.length_to(link, base, pin);
        let reason = self.reason(&[link]);
        let omega = self.board.quotient(speed, length, reason);
        let omega = self.rate_as_calculated(Order::Velocity, link, omega);
        self.set_rate(Order::Velocity, link, omega);
        self.act(Act::Calculate(Calculation::Omega {
            link,
            quantity,
            ends: [base, pin],
            speed: speed.value().abs(),
            length: length.value(),
            value: omega.value(),
        }));
    }

    /// Reads the sliding velocity along a route.
    pub(super) fn read_slip(
        &mut self,
        route: &Route,
        target: Target,
        (slide, back): (usize, bool),
        (label, image): (Label, Point),
        along: Mm,
    ) {
        let pin = target.pin();
        let guide = self.mechanism.slides[slide].guide.link;
        let scale = self.polygon_scale(Order::Velocity);
        let read = self.board.read(along, scale);
        let read = self.as_read(Quantity::Slip(self.riding_point(slide, pin), guide), read);
        // Read from the guide's point to the rider: against the ray where it was drawn backwards.
        let speed = if back { self.board.opposite(read) } else { read };
        self.motion_mut(Order::Velocity).slidings[slide] = Some(speed);
        let (quantity, reversed) = self.sliding_unknown(Order::Velocity, target, (slide, back));
        let ends = [route.foot, (label, image)];
        let [tail, head] = if reversed { [ends[1], ends[0]] } else { ends };
        let grounded = self.solved_side(slide, back) == Some(LinkId::FRAME);
        let kind = if grounded { VectorKind::Absolute } else { VectorKind::Sliding };
        let vector = self.note_vector(Order::Velocity, (kind, quantity, Some(route.claim)), tail, head);
        self.act_read(Order::Velocity, vector);
        let [from, to] = if back { [ends[1].1, ends[0].1] } else { [ends[0].1, ends[1].1] };
        self.note_part(Quantity::Slip(self.riding_point(slide, pin), guide), from, to);
    }

    /// The point of a sliding pair's rider by which its sliding is named.
    pub(super) fn riding_point(&self, slide: usize, pin: PointId) -> PointId {
        match self.mechanism.slides[slide].rider {
            Rider::Pin { point, .. } => point,
            Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied().unwrap_or(pin),
        }
    }

    /// The distance of a point from a link's pin: the link's own length, or measured where one of them is not
    /// the link's.
    pub(super) fn length_to(&mut self, link: LinkId, base: PointId, point: PointId) -> Amount {
        let own = &self.mechanism.link(link).points;
        if own.contains(&base) && own.contains(&point) {
            return self.length(link, base, point);
        }
        if let Some(radius) = self.contact_radius(link, base, point) {
            return self.board.amount(radius);
        }
        self.measured(base, point)
    }

    /// The given radius of a wheel from its centre to its contact point.
    fn contact_radius(&self, link: LinkId, centre: PointId, contact: PointId) -> Option<Given> {
        match self.mechanism.rolls[self.mechanism.roll_at(contact)?] {
            Roll::Circles { links, centres, radii, .. } => {
                (0..2).find(|&i| links[i] == link && centres[i] == centre).map(|i| radii[i])
            }
            Roll::Line { wheel, centre: its, radius, .. } => {
                (wheel == link && its == centre).then_some(radius)
            }
        }
    }

    /// The distance of two points, measured on the skeleton and said so.
    pub(super) fn measured(&mut self, from: PointId, to: PointId) -> Amount {
        let (a, b) = (self.at(from), self.at(to));
        let mm = self.board.distance(a, b);
        let scale = self.length_scale();
        let value = self.board.read(mm, scale);
        self.act(Act::MeasureLength { from, to, mm: mm.value(), value: value.value() });
        value
    }

    /// ω or ε of the blocks of a group: a block turns with its guide, and on an arc with the radius.
    pub(super) fn rates_of_blocks(&mut self, order: Order, links: &[LinkId]) {
        for index in 0..self.mechanism.slides.len() {
            let slide = self.mechanism.slides[index];
            let Rider::Pin { block: Some(block), .. } = slide.rider else { continue };
            if !links.contains(&block) {
                continue;
            }
            let mut rate = self.rate(order, slide.guide.link);
            if let Path::Arc { radius, .. } = slide.guide.path {
                if let Some(along) = self.motion(order).slidings[index] {
                    let radius = self.board.amount(radius);
                    let reason = self.reason(&[slide.guide.link]);
                    let turn = self.board.quotient(along, radius, reason);
                    rate = self.board.sum(rate, turn);
                }
            } else if slide.guide.link == LinkId::FRAME && order == Order::Velocity {
                self.tell_translation(order, block);
            }
            self.set_rate(order, block, rate);
        }
    }

    /// ω or ε of links that slide without turning against a solved link: that of the solved one.
    pub(super) fn rates_by_riding(&mut self, order: Order, kind: GroupKind) {
        for (link, carrier) in kind.riding(self.mechanism) {
            let rate = self.rate(order, carrier);
            self.set_rate(order, link, rate);
        }
    }

    pub(super) fn set_rate(&mut self, order: Order, link: LinkId, rate: Amount) {
        self.motion_mut(order).rotations[link.0] = Some(rate);
    }

    /// The vector from the pole to an image, read; one that was laid off from the pole stands there already.
    pub(super) fn absolute_vector(&mut self, order: Order, quantity: Quantity, label: Label, image: Point) {
        let stands = self.leads_from_pole(order, label)
            && self.polygon(order).is_some_and(|polygon| {
                let same = |v: &Vector| (v.quantity, v.tail, v.head) == (quantity, Label::Pole, label);
                polygon.vectors.iter().any(same)
            });
        if stands {
            return;
        }
        let pole = self.board.origin();
        let vector = self.note_vector(
            order,
            (VectorKind::Absolute, quantity, None),
            (Label::Pole, pole),
            (label, image),
        );
        self.act_read(order, vector);
    }

    /// The image of a link's point under a pin that is not one of its points, where it is drawn.
    pub(super) fn image_drawn_under(&self, order: Order, pin: PointId, link: LinkId) -> Option<Point> {
        let known = self.coincident.iter().find(|c| c.order == order && c.pin == pin && c.link == link);
        known.map(|known| known.image)
    }

    /// The image of the point of a solved link under a pin: V = ω l from a known image of the link.
    pub(super) fn image_under(&mut self, order: Order, pin: PointId, link: LinkId) -> Point {
        if link == LinkId::FRAME {
            return self.board.origin();
        }
        if self.mechanism.link(link).points.contains(&pin) {
            return self.image(order, pin);
        }
        if let Some(known) = self.image_drawn_under(order, pin, link) {
            return known;
        }
        let image = match self.base_for(order, pin, link) {
            Some(base) if self.translates[link.0] => {
                self.tell_translation(order, link);
                self.act(Act::SameImage { label: self.label_under(pin, link), with: self.label(base) });
                self.image(order, base)
            }
            Some(base) if order == Order::Acceleration => {
                self.board.purpose("acceleration of a point under a pin");
                self.acceleration_about(link, base, pin)
            }
            Some(base) => {
                self.board.purpose("velocity of a point under a pin");
                return self.velocity_under(link, base, pin);
            }
            None => self.translated_image(order, link, pin),
        };
        let image = self.note_under(order, pin, link, image);
        let label = self.label_under(pin, link);
        let quantity = match order {
            Order::Acceleration => Quantity::CoincidentAcceleration(pin, link),
            _ => Quantity::CoincidentVelocity(pin, link),
        };
        self.absolute_vector(order, quantity, label, image);
        image
    }

    /// The same for velocities, about a base. The whole vector bears the name before its part against the base does: who
    /// looks for the quantity finds the whole.
    fn velocity_under(&mut self, link: LinkId, base: PointId, pin: PointId) -> Point {
        let image = self.turned_about(link, base, pin);
        let image = self.note_under(Order::Velocity, pin, link, image);
        if self.mechanism.is_fixed(base) {
            self.note_turned(link, base, pin, image);
            return image;
        }
        let pole = self.board.origin();
        let whole = (VectorKind::Absolute, Quantity::CoincidentVelocity(pin, link), None);
        let head = (self.label_under(pin, link), image);
        let whole = self.note_vector(Order::Velocity, whole, (Label::Pole, pole), head);
        self.note_turned(link, base, pin, image);
        self.act_read(Order::Velocity, whole);
        image
    }

    /// The point about which the image under a pin is laid off: the centre of a wheel for its contact point.
    fn base_for(&mut self, order: Order, pin: PointId, link: LinkId) -> Option<PointId> {
        let centre = self.mechanism.roll_at(pin).and_then(|roll| match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => (0..2).find(|&i| links[i] == link).map(|i| centres[i]),
            Roll::Line { wheel, centre, .. } => (wheel == link).then_some(centre),
        });
        centre.or_else(|| self.known_point_of(order, link))
    }

    /// A point of a solved link whose image is known, a fixed one first.
    fn known_point_of(&mut self, order: Order, link: LinkId) -> Option<PointId> {
        let points = self.mechanism.link(link).points.clone();
        let fixed = points.iter().copied().find(|&p| self.mechanism.is_fixed(p));
        fixed.or_else(|| points.into_iter().find(|&p| self.images(order)[p.0].is_some()))
    }

    /// The image of a point of a link of which no joint has one: from the point under the pin by which the
    /// link was solved.
    pub(super) fn translated_image(&mut self, order: Order, link: LinkId, point: PointId) -> Point {
        let solved_by = self.coincident.iter().find(|c| c.order == order && c.link == link).map(|c| c.pin);
        match solved_by {
            Some(pin) => self.riding_image(order, link, pin, point),
            None => self.no_point(Missing::Image(order, point)),
        }
    }

    /// V = ω l about a point whose image is known, laid off perpendicular in the sense of ω.
    pub(super) fn velocity_about(&mut self, link: LinkId, base: PointId, point: PointId) -> Point {
        if let Some(image) = self.image_as_one(Order::Velocity, link, base, point) {
            return image;
        }
        let image = self.turned_about(link, base, point);
        self.note_turned(link, base, point, image);
        image
    }

    /// The image of a point that the scene states where another one is: there is no line between them about which it turns.
    pub(super) fn image_as_one(
        &mut self,
        order: Order,
        link: LinkId,
        base: PointId,
        point: PointId,
    ) -> Option<Point> {
        if !self.mechanism.link(link).states_as_one(base, point) {
            return None;
        }
        self.act(Act::SameImage { label: self.label(point), with: self.label(base) });
        Some(self.image(order, base))
    }

    /// What a link's rotation gives a point seen from another: V_BA, or V_B about a fixed point.
    fn turning_velocity(&self, link: LinkId, base: PointId, point: PointId) -> Quantity {
        if self.mechanism.link(link).points.contains(&point) {
            self.relative_velocity(point, base)
        } else {
            Quantity::CoincidentVelocity(point, link)
        }
    }

    /// Notes the vector that a link's rotation gives, and that it is laid off.
    fn note_turned(&mut self, link: LinkId, base: PointId, point: PointId, image: Point) {
        let from = self.image(Order::Velocity, base);
        let claim = Claim::Perpendicular(Reference::Points(base, point));
        let quantity = self.turning_velocity(link, base, point);
        let vector = self.note_vector(
            Order::Velocity,
            (self.kind_of(base), quantity, Some(claim)),
            (self.label(base), from),
            (self.label_under(point, link), image),
        );
        let (a, b) = (from.value(), image.value());
        let mm = libm::hypot(b[0] - a[0], b[1] - a[1]);
        self.act(Act::LayOffVector { vector, value: mm * self.scales.of(Dimension::Velocity), mm });
    }

    /// Whether the scene states the speed of this point about this base: then nothing is calculated.
    fn is_stated_speed(&self, link: LinkId, base: PointId, point: PointId) -> bool {
        self.mechanism.inputs.iter().any(|input| {
            let Input::Speed { link: of, point: its, .. } = *input else { return false };
            (of, its) == (link, point) && self.mechanism.link(link).points.first() == Some(&base)
        })
    }

    /// The image that V = ω l leads to from that of a point, and the calculation.
    fn turned_about(&mut self, link: LinkId, base: PointId, point: PointId) -> Point {
        let scale = self.polygon_scale(Order::Velocity);
        let omega = self.rate(Order::Velocity, link);
        let at_joint = self.may_be_at_joint(link, base, point);
        let arm = if at_joint { self.arm_along_guide(link, base, point) } else { None };
        let length = match arm {
            Some((_, length)) => length,
            None => self.length_to(link, base, point),
        };
        let speed = self.board.product(omega, length);
        let quantity = self.turning_velocity(link, base, point);
        if !self.is_stated_speed(link, base, point) {
            let ends = [base, point];
            self.act_turning(Order::Velocity, quantity, link, ends, [omega, length, speed]);
        }
        let from = self.image(Order::Velocity, base);
        let square = match arm {
            Some((along, _)) => self.board.quarter_turn(along),
            None if at_joint => {
                let by = self.square_parts(omega, [base, point], Order::Velocity);
                return self.board.moved(from, by);
            }
            None => self.square_to(link, base, point),
        };
        let mm = self.board.to_paper(speed, scale);
        self.lay_off_vector(quantity, from, square, mm)
    }

    /// Whether a point may be at a joint of a link whose turning is known: no line leads from the one to the other then. It is
    /// where the link touches a wheel by its own line, or on a guide of the link through that joint, as the disc of Oldham's
    /// coupling passes the centres of both shafts. A pin that tells how the link turns is never there.
    pub(super) fn may_be_at_joint(&self, link: LinkId, joint: PointId, point: PointId) -> bool {
        let guided = self.guide_through(link, joint, point).is_some() && self.departures.is_empty();
        guided || self.may_touch_at_joint(link, [joint, point])
    }

    /// Whether one of two points is where the link touches a wheel by its own line: that place passes the link's joints.
    pub(super) fn may_touch_at_joint(&self, link: LinkId, ends: [PointId; 2]) -> bool {
        let touches = |&point: &PointId| {
            let roll = self.mechanism.roll_at(point).map(|roll| self.mechanism.rolls[roll]);
            matches!(roll, Some(Roll::Line { guide, .. }) if guide.link == link)
        };
        ends.iter().any(touches) && self.departures.is_empty()
    }

    /// The guide through a joint of a link that is driven, or turns with what rides on it, along which a point slides.
    fn guide_through(&self, link: LinkId, joint: PointId, point: PointId) -> Option<usize> {
        let mechanism = self.mechanism;
        let driven = mechanism.inputs.iter().any(|input| {
            matches!(*input, Input::Angle { link: of, .. } | Input::Speed { link: of, .. } if of == link)
        });
        let inner = self.structure.trials.iter().flat_map(|trial| &trial.groups);
        let carries = |group: &Group| matches!(group.kind, GroupKind::Rpp { lever, .. } if lever == link);
        if !driven && !inner.chain(&self.structure.groups).any(carries) {
            return None;
        }
        (0..mechanism.slides.len()).find(|&slide| {
            let guide = mechanism.slides[slide].guide;
            guide.link == link
                && self.riding_point(slide, joint) == point
                && mechanism.leads_through(&guide, joint)
        })
    }

    /// The direction of such a guide, and how far the point is along it from the joint; forward is positive.
    pub(super) fn arm_along_guide(
        &mut self,
        link: LinkId,
        joint: PointId,
        point: PointId,
    ) -> Option<(Direction, Amount)> {
        let slide = self.guide_through(link, joint, point)?;
        let (along, _) = self.tangent(slide, point);
        let (through, at) = (self.at(joint), self.at(point));
        let [mm, _] = self.board.square_off(Line { through, along }, at);
        let scale = self.length_scale();
        let length = self.board.read(mm, scale);
        let (paper, value) = (mm.value().abs(), length.value().abs());
        self.act(Act::MeasureLength { from: joint, to: point, mm: paper, value });
        Some((along, length))
    }

    /// A rate times the way from one point to another, turned by +90°, component by component: ω l or ε l as lengths on paper.
    /// It needs no direction, and is nothing where the way is.
    pub(super) fn square_parts(&mut self, rate: Amount, ends: [PointId; 2], order: Order) -> [Mm; 2] {
        let [x, y] = self.way_times(rate, ends);
        let scale = self.polygon_scale(order);
        [self.board.opposite(y), x].map(|part| self.board.to_paper(part, scale))
    }

    /// The components of the way from one point to another, each times an amount.
    pub(super) fn way_times(&mut self, by: Amount, [from, to]: [PointId; 2]) -> [Amount; 2] {
        let (from, to) = (self.at(from), self.at(to));
        let space = self.length_scale();
        self.board.between(from, to).map(|part| {
            let part = self.board.read(part, space);
            self.board.product(by, part)
        })
    }

    /// Calculates V = ω l or Aᵗ = ε l.
    pub(super) fn act_turning(
        &mut self,
        order: Order,
        quantity: Quantity,
        link: LinkId,
        ends: [PointId; 2],
        [rate, length, part]: [Amount; 3],
    ) {
        let (rate, length, value) = (rate.value(), length.value().abs(), part.value().abs());
        self.act(Act::Calculate(match order {
            Order::Acceleration => {
                Calculation::Tangential { quantity, link, ends, alpha: rate, length, value }
            }
            _ => Calculation::Speed { quantity, link, ends, omega: rate, length, value },
        }));
    }

    /// A point of a link that slides without turning: the image under its pin, where what it slides on cannot
    /// turn either; else V = ω l from there, whatever ω is at this instant.
    pub(super) fn riding_image(&mut self, order: Order, link: LinkId, pin: PointId, point: PointId) -> Point {
        let from = self.image_under(order, pin, link);
        if self.translates[link.0] {
            self.tell_translation(order, link);
            self.act(Act::SameImage {
                label: self.label_under(point, link),
                with: self.label_under(pin, link),
            });
            return from;
        }
        if self.mechanism.link(link).points.contains(&pin) {
            return self.image_about(order, link, pin, point);
        }
        let start = (self.label_under(pin, link), from);
        let head = self.label_under(point, link);
        self.lay_off_turn(order, link, [pin, point], start, (1, Some(head))).1
    }

    /// base→point : base→pin on a straight link, signed; `None` for other links.
    pub(super) fn straight_ratio(
        &mut self,
        link: LinkId,
        base: PointId,
        pin: PointId,
        point: PointId,
    ) -> Option<Ratio> {
        self.is_straight(link).then(|| self.proportions(link, base, pin, point)[0])
    }

    /// Divides an image line as the link is divided.
    pub(super) fn divide_image(
        &mut self,
        order: Order,
        (base, pin): (PointId, PointId),
        point: PointId,
        ratio: Ratio,
    ) -> Point {
        let (from, to) = (self.image(order, base), self.image(order, pin));
        let image = self.board.divide(from, to, ratio);
        self.act(Act::DivideImage {
            label: self.label(point),
            from: self.label(base),
            to: self.label(pin),
            ratio: ratio.value(),
        });
        image
    }

    /// Whether perpendiculars to the sides base–point and pin–point cross well enough to construct from.
    pub(super) fn crosses_well(&mut self, base: PointId, pin: PointId, point: PointId) -> bool {
        let [p, q, e] = [base, pin, point].map(|x| self.at(x).value());
        let [u, v] = [[e[0] - p[0], e[1] - p[1]], [e[0] - q[0], e[1] - q[1]]];
        let cross = u[0] * v[1] - u[1] * v[0];
        cross.abs() > FLATTEST_CROSSING * libm::hypot(u[0], u[1]) * libm::hypot(v[0], v[1])
    }

    /// A corner of an image, by the figure similar to the link.
    pub(super) fn similar_image(
        &mut self,
        order: Order,
        link: LinkId,
        (base, pin): (PointId, PointId),
        point: PointId,
    ) -> Point {
        let [along, across] = self.proportions(link, base, pin, point);
        let ends = [self.image(order, base), self.image(order, pin)];
        let base_labels = [self.label(base), self.label(pin)];
        self.act(Act::CompleteImage { label: self.label(point), link, base: base_labels });
        self.board.similar(ends, along, across)
    }
}
