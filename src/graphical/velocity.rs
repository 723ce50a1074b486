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

use crate::board::{Amount, Bench, Line, Mm, Point, Ratio};
use crate::given::Given;
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::{Group, GroupKind};
use crate::mechanism::{Input, LinkId, Path, PointId, Rider, Roll};
use crate::plan::{GroupStep, Plan};

use super::construction::{
    Act, Calculation, Claim, Equation, Label, Reference, Term, TermDirection, VectorKind,
};
use super::draughtsman::Draughtsman;

/// Two sides of an image triangle that cross flatter than this are not constructed from but replaced by
/// the similar figure (sine of about 3°, `drawing.md`).
pub(super) const FLATTEST_CROSSING: f64 = 0.05;

/// Draws the steps of the velocity polygon.
pub(super) fn draw<B: Bench>(d: &mut Draughtsman<'_, B>, plan: &Plan) {
    d.open_polygon(Order::Velocity);
    d.omegas[LinkId::FRAME.0] = Some(d.rest());
    d.step(Order::Velocity, &[], Vec::new());
    d.act(Act::MarkPole);
    for step in &plan.velocity {
        d.velocity_of(step, &d.structure.groups[step.group]);
    }
}

/// A way to the sought image: from a known image along a line of unknown length.
struct Route<B: Bench> {
    from: (Label, Point<B>),
    ray: Line<B>,
    claim: Claim,
    unknown: Unknown,
}

/// What the length along a route tells.
#[derive(Clone, Copy)]
pub(super) enum Unknown {
    /// A link turns about its base.
    Turn {
        link: LinkId,
        base: PointId,
        /// The point whose image the route leads to.
        to: PointId,
    },
    /// A rider slides along its guide.
    Slide {
        slide: usize,
        /// The image of the rider is known and that of the guide's point is sought.
        back: bool,
    },
    /// A wheel's centre runs along the body on which it rolls.
    Roll {
        /// Index of the rolling pair.
        roll: usize,
        /// The wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
    },
}

/// The image that a group's two routes lead to.
#[derive(Clone, Copy)]
pub(super) enum Target {
    /// That of the group's pin.
    Pin(PointId),
    /// That of the point of a link under a pin of a solved link.
    Under(PointId, LinkId),
}

impl Target {
    pub(super) fn pin(self) -> PointId {
        match self {
            Self::Pin(pin) | Self::Under(pin, _) => pin,
        }
    }
}

/// The image that a group is solved for, and the two unknowns that lead to it; those of the frame first.
pub(super) fn routes_of(kind: GroupKind) -> Option<(Target, [Unknown; 2])> {
    Some(match kind {
        GroupKind::Rrr { links, bases, pin } => {
            (Target::Pin(pin), [0, 1].map(|i| Unknown::Turn { link: links[i], base: bases[i], to: pin }))
        }
        GroupKind::Rrp { rod, base, pin, slide } => (
            Target::Pin(pin),
            [Unknown::Turn { link: rod, base, to: pin }, Unknown::Slide { slide, back: false }],
        ),
        GroupKind::Rolling { rod, base, wheel, centre, roll } => (
            Target::Pin(centre),
            [Unknown::Turn { link: rod, base, to: centre }, Unknown::Roll { roll, wheel, centre }],
        ),
        GroupKind::Prp { pin, slides } => {
            (Target::Pin(pin), slides.map(|slide| Unknown::Slide { slide, back: false }))
        }
        GroupKind::Rpr { lever, base, pin, slide, .. } => (
            Target::Under(pin, lever),
            [Unknown::Turn { link: lever, base, to: pin }, Unknown::Slide { slide, back: true }],
        ),
        GroupKind::Yoke { link, ride, pin, slot } => (
            Target::Under(pin, link),
            [Unknown::Slide { slide: ride, back: false }, Unknown::Slide { slide: slot, back: true }],
        ),
        GroupKind::Driver { .. }
        | GroupKind::TrialDriver { .. }
        | GroupKind::DrivenSlide { .. }
        | GroupKind::Wheel { .. }
        | GroupKind::Higher { .. }
        | GroupKind::Other => return None,
    })
}

/// Base and pin between which the images of a link's further points are found.
pub(super) fn main_base(kind: GroupKind, link: LinkId) -> Option<(PointId, PointId)> {
    match kind {
        GroupKind::Rrr { links, bases, pin } => {
            links.iter().position(|&l| l == link).map(|index| (bases[index], pin))
        }
        GroupKind::Rrp { rod, base, pin, .. } if rod == link => Some((base, pin)),
        GroupKind::Rolling { rod, base, centre, .. } if rod == link => Some((base, centre)),
        _ => None,
    }
}

impl<B: Bench> Draughtsman<'_, B> {
    /// Draws the velocity polygon of one group.
    pub(super) fn velocity_of(&mut self, step: &GroupStep, group: &Group) {
        match group.kind {
            GroupKind::Driver { base, input } => self.velocity_of_driver(step, group.links[0], base, input),
            GroupKind::DrivenSlide { slide, input } => self.velocity_of_slide(step, group, slide, input),
            GroupKind::Wheel { wheel, centre, roll } => self.velocity_of_wheel(step, wheel, centre, roll),
            GroupKind::Rolling { wheel, centre, roll, .. } => {
                self.velocity_of_group(step, group);
                self.velocity_of_wheel(step, wheel, centre, roll);
            }
            GroupKind::Higher { trial } => self.polygon_by_trial(Order::Velocity, step, trial),
            _ => self.velocity_of_group(step, group),
        }
        self.rates_of_blocks(Order::Velocity, &group.links);
        for &link in &group.links {
            self.note_link_image(Order::Velocity, link);
        }
    }

    /// Zero, exact.
    pub(super) fn rest(&mut self) -> Amount<B> {
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
        let omega = match self.mechanism.inputs[input] {
            Input::Angle { omega, .. } => self.board.amount(omega),
            Input::Speed { point, speed, .. } => {
                let Some(&first) = self.mechanism.link(link).points.first() else { return };
                let length = self.length(link, first, point);
                let speed = self.board.amount(speed);
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
                omega
            }
            Input::Slide { .. } => return,
        };
        self.omegas[link.0] = Some(omega);
        self.driven_velocities(step, link, base);
    }

    /// V = ω l of each wanted point of a link whose ω is known, about its base.
    pub(super) fn driven_velocities(&mut self, step: &GroupStep, link: LinkId, base: PointId) {
        for &(_, point) in &step.points {
            let image = self.velocity_about(link, base, point);
            self.note_image(Order::Velocity, point, image);
            let from = self.image(Order::Velocity, base);
            let claim = Claim::Perpendicular(Reference::Points(base, point));
            let quantity = self.relative_velocity(point, base);
            let vector = self.note_vector(
                Order::Velocity,
                (self.kind_of(base), quantity, Some(claim)),
                (self.label(base), from),
                (self.label(point), image),
            );
            let (a, b) = (from.value(), image.value());
            let mm = libm::hypot(b[0] - a[0], b[1] - a[1]);
            self.act(Act::LayOffVector { vector, value: mm * self.scales.velocity, mm });
            if !self.mechanism.is_fixed(base) {
                let label = self.label(point);
                self.absolute_vector(Order::Velocity, Quantity::Velocity(point), label, image);
            }
        }
    }

    /// The direction from `base` to `point` on the skeleton, turned by +90°: that of the velocity of
    /// `point` for a positive ω.
    pub(super) fn square_to(
        &mut self,
        link: LinkId,
        base: PointId,
        point: PointId,
    ) -> crate::board::Direction<B> {
        let along = self.outward(link, base, point);
        self.board.quarter_turn(along)
    }

    /// The direction from `base` to `point` on the skeleton.
    pub(super) fn outward(
        &mut self,
        link: LinkId,
        base: PointId,
        point: PointId,
    ) -> crate::board::Direction<B> {
        let (from, to) = (self.at(base), self.at(point));
        let reason = self.reason(&[link]);
        self.board.toward(from, to, reason).0
    }

    /// The given sliding velocity, laid off along the guide from the image of the guide's point.
    fn velocity_of_slide(&mut self, step: &GroupStep, group: &Group, slide: usize, input: usize) {
        let Input::Slide { velocity, .. } = self.mechanism.inputs[input] else { return };
        let (rider, guide) = (self.mechanism.slides[slide].rider, self.mechanism.slides[slide].guide.link);
        let first = self.riding_point(slide, PointId(0));
        self.board.purpose("velocity of a driven slide");
        self.step(Order::Velocity, &group.links, Vec::new());
        let (along, _) = self.tangent(slide, first);
        let scale = self.polygon_scale(Order::Velocity);
        let speed = self.board.amount(velocity);
        let mm = self.board.to_paper(speed, scale);
        let from = self.image_under(Order::Velocity, first, guide);
        let image = self.board.lay_off(from, along, mm);
        self.slips[slide] = Some(speed);
        self.note_image(Order::Velocity, first, image);
        let fixed = guide == LinkId::FRAME;
        let (kind, quantity) = if fixed {
            (VectorKind::Absolute, Quantity::Velocity(first))
        } else {
            (VectorKind::Sliding, Quantity::Slip(first, guide))
        };
        let claim = Claim::Parallel(Reference::Guide(slide));
        let (tail, head) = ((self.label_under(first, guide), from), (self.label(first), image));
        let vector = self.note_vector(Order::Velocity, (kind, quantity, Some(claim)), tail, head);
        self.act(Act::LayOffVector { vector, value: speed.value().abs(), mm: mm.value().abs() });
        self.note_part(Quantity::Slip(first, guide), from, image);
        if !fixed {
            let label = self.label(first);
            self.absolute_vector(Order::Velocity, Quantity::Velocity(first), label, image);
        }
        if let Rider::Link { link, .. } = rider {
            let rate = self.rate(Order::Velocity, guide);
            self.translates[link.0] = self.translates[guide.0];
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
            self.note_image(order, point, image);
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
        let Some(&contact) = self.mechanism.contacts.get(roll) else { return };
        self.board.purpose("velocity of a contact point");
        self.step(Order::Velocity, &[wheel], Vec::new());
        let other = self.rolled_on(roll, wheel);
        let image = self.contact_image(Order::Velocity, roll, other);
        self.note_under(Order::Velocity, contact, wheel, image);
        let labels = (self.label_under(contact, wheel), self.label_under(contact, other));
        self.act(Act::SameImage { label: labels.0, with: labels.1 });
        let from = self.image(Order::Velocity, centre);
        let quantity = Quantity::CoincidentVelocity(contact, wheel);
        let claim = Claim::Perpendicular(Reference::Points(centre, contact));
        let vector = self.note_vector(
            Order::Velocity,
            (self.kind_of(centre), quantity, Some(claim)),
            (self.label(centre), from),
            (labels.0, image),
        );
        self.act_read(Order::Velocity, vector);
        let square = self.square_to(wheel, centre, contact);
        let [along, _] = self.board.square_off(Line { through: from, along: square }, image);
        let scale = self.polygon_scale(Order::Velocity);
        let speed = self.board.read(along, scale);
        let radius = self.length_to(wheel, centre, contact);
        let reason = self.reason(&[wheel]);
        let omega = self.board.quotient(speed, radius, reason);
        self.omegas[wheel.0] = Some(omega);
        self.act(Act::Calculate(Calculation::Omega {
            link: wheel,
            quantity,
            ends: [centre, contact],
            speed: speed.value().abs(),
            length: radius.value(),
            value: omega.value(),
        }));
        for &(of, point) in &step.points {
            if of != wheel {
                continue;
            }
            let image = self.velocity_about(wheel, centre, point);
            self.note_image(Order::Velocity, point, image);
            let label = self.label(point);
            self.absolute_vector(Order::Velocity, Quantity::Velocity(point), label, image);
        }
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
    pub(super) fn contact_image(&mut self, order: Order, roll: usize, body: LinkId) -> Point<B> {
        let Some(&contact) = self.mechanism.contacts.get(roll) else { return self.board.origin() };
        self.image_under(order, contact, body)
    }

    /// From the image of the base a line perpendicular to the link.
    fn velocity_arm(&mut self, link: LinkId, base: PointId, to: PointId) -> Route<B> {
        let image = self.image(Order::Velocity, base);
        let along = self.square_to(link, base, to);
        Route {
            from: (self.label(base), image),
            ray: Line { through: image, along },
            claim: Claim::Perpendicular(Reference::Points(base, to)),
            unknown: Unknown::Turn { link, base, to },
        }
    }

    /// From the image of the guide's point (or backwards from the rider's) a line along the guide.
    fn velocity_slide(&mut self, slide: usize, back: bool, pin: PointId) -> Route<B> {
        let link = self.mechanism.slides[slide].guide.link;
        let (along, _) = self.tangent(slide, pin);
        let from = if back {
            (self.label(pin), self.image(Order::Velocity, pin))
        } else {
            (self.label_under(pin, link), self.image_under(Order::Velocity, pin, link))
        };
        Route {
            from,
            ray: Line { through: from.1, along },
            claim: Claim::Parallel(Reference::Guide(slide)),
            unknown: Unknown::Slide { slide, back },
        }
    }

    /// The point about which a rolling wheel's centre moves, where the other body is a circle.
    pub(super) fn other_centre(&self, roll: usize, wheel: LinkId) -> Option<PointId> {
        match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => Some(centres[usize::from(links[0] == wheel)]),
            Roll::Line { .. } => None,
        }
    }

    /// From the image of the other centre a line perpendicular to the line of centres; on a straight line
    /// from the image of the point under the centre a line along it.
    fn velocity_roll(&mut self, roll: usize, wheel: LinkId, centre: PointId) -> Route<B> {
        let unknown = Unknown::Roll { roll, wheel, centre };
        let body = self.rolled_on(roll, wheel);
        if let Some(other) = self.other_centre(roll, wheel) {
            let image = self.image(Order::Velocity, other);
            let along = self.square_to(body, other, centre);
            let claim = Claim::Perpendicular(Reference::Points(other, centre));
            let from = (self.label(other), image);
            return Route { from, ray: Line { through: image, along }, claim, unknown };
        }
        let image = self.image_under(Order::Velocity, centre, body);
        let (along, claim) = self.rolling_direction(roll, wheel, centre);
        let from = (self.label_under(centre, body), image);
        Route { from, ray: Line { through: image, along }, claim, unknown }
    }

    /// Along the line on which a wheel rolls: square to its contact radius.
    pub(super) fn rolling_direction(
        &mut self,
        roll: usize,
        wheel: LinkId,
        centre: PointId,
    ) -> (crate::board::Direction<B>, Claim) {
        let contact = self.mechanism.contacts.get(roll).copied().unwrap_or(centre);
        let along = self.square_to(wheel, centre, contact);
        (along, Claim::Perpendicular(Reference::Points(centre, contact)))
    }

    /// What the velocity of a rolling wheel's centre is called, seen from where its route begins.
    fn rolling_velocity(&self, roll: usize, wheel: LinkId, centre: PointId) -> (Quantity, VectorKind) {
        match self.other_centre(roll, wheel) {
            Some(other) => (self.relative_velocity(centre, other), self.kind_of(other)),
            None if self.rolled_on(roll, wheel) == LinkId::FRAME => {
                (Quantity::Velocity(centre), VectorKind::Absolute)
            }
            None => (Quantity::Slip(centre, self.rolled_on(roll, wheel)), VectorKind::Sliding),
        }
    }

    /// Two lines of unknown length meet in the sought image.
    fn velocity_of_group(&mut self, step: &GroupStep, group: &Group) {
        let kind = group.kind;
        let Some((target, unknowns)) = routes_of(kind) else { return };
        self.board.purpose("velocity image");
        let pin = target.pin();
        let links: Vec<LinkId> =
            group.links.iter().copied().filter(|&l| !self.mechanism.link(l).block).collect();
        self.step(Order::Velocity, &links, Vec::new());
        let routes = unknowns.map(|unknown| match unknown {
            Unknown::Turn { link, base, to } => self.velocity_arm(link, base, to),
            Unknown::Slide { slide, back } => self.velocity_slide(slide, back, pin),
            Unknown::Roll { roll, wheel, centre } => self.velocity_roll(roll, wheel, centre),
        });
        let equation = self.velocity_equation(target, unknowns);
        self.equation(equation);
        for route in &routes {
            self.act(Act::DrawRay { from: route.from.0, claim: route.claim });
        }
        let reason = self.reason(&links);
        let meet = self.board.meet_lines(routes[0].ray, routes[1].ray, reason);
        let label = match target {
            Target::Pin(pin) => {
                self.note_image(Order::Velocity, pin, meet.at);
                self.label(pin)
            }
            Target::Under(pin, link) => {
                self.note_under(Order::Velocity, pin, link, meet.at);
                self.label_under(pin, link)
            }
        };
        self.act(Act::MarkMeet { label, crossing: meet.crossing });
        for (route, along) in routes.iter().zip(meet.along) {
            self.note_ray(Order::Velocity, route.from.1, meet.at, route.claim);
            match route.unknown {
                Unknown::Turn { link, base, .. } => {
                    self.read_omega(route, target, (link, base), (label, meet.at), along);
                }
                Unknown::Slide { slide, back } => {
                    self.read_slip(route, target, (slide, back), (label, meet.at), along);
                }
                Unknown::Roll { roll, wheel, centre } => {
                    let scale = self.polygon_scale(Order::Velocity);
                    self.rolling_speeds[roll] = Some(self.board.read(along, scale));
                    let (quantity, kind) = self.rolling_velocity(roll, wheel, centre);
                    let vector = self.note_vector(
                        Order::Velocity,
                        (kind, quantity, Some(route.claim)),
                        route.from,
                        (label, meet.at),
                    );
                    self.act_read(Order::Velocity, vector);
                }
            }
        }
        self.rates_by_riding(Order::Velocity, kind);
        let reached_from_pole = routes.iter().any(|route| route.from.0 == Label::Pole);
        if let (Target::Pin(pin), false) = (target, reached_from_pole) {
            self.absolute_vector(Order::Velocity, Quantity::Velocity(pin), label, meet.at);
        }
        if let (Target::Under(pin, link), false) = (target, reached_from_pole) {
            let quantity = Quantity::CoincidentVelocity(pin, link);
            self.absolute_vector(Order::Velocity, quantity, label, meet.at);
        }
        self.further_velocities(step, kind);
    }

    /// The line of an open constraint from its known end.
    pub(super) fn closing_line(&mut self, unknown: Unknown, end: PointId) -> Line<B> {
        self.closing_route(unknown, end).ray
    }

    fn closing_route(&mut self, unknown: Unknown, end: PointId) -> Route<B> {
        match unknown {
            Unknown::Turn { link, base, to } => self.velocity_arm(link, base, to),
            Unknown::Slide { slide, back } => self.velocity_slide(slide, back, end),
            Unknown::Roll { roll, wheel, centre } => self.velocity_roll(roll, wheel, centre),
        }
    }

    /// Reads what an open constraint has become when its end's image is known.
    pub(super) fn read_closing_velocity(
        &mut self,
        unknown: Unknown,
        target: Target,
        (label, image): (Label, Point<B>),
    ) {
        let route = self.closing_route(unknown, target.pin());
        let [along, _] = self.board.square_off(route.ray, image);
        self.note_ray(Order::Velocity, route.from.1, image, route.claim);
        match unknown {
            Unknown::Turn { link, base, .. } => {
                self.read_omega(&route, target, (link, base), (label, image), along);
            }
            Unknown::Slide { slide, back } => {
                self.read_slip(&route, target, (slide, back), (label, image), along);
            }
            Unknown::Roll { .. } => {}
        }
    }

    /// Reads V along a route and divides by the link's length.
    fn read_omega(
        &mut self,
        route: &Route<B>,
        target: Target,
        (link, base): (LinkId, PointId),
        (label, image): (Label, Point<B>),
        along: Mm<B>,
    ) {
        let scale = self.polygon_scale(Order::Velocity);
        let pin = target.pin();
        let quantity = match target {
            Target::Pin(pin) => self.relative_velocity(pin, base),
            Target::Under(pin, link) => Quantity::CoincidentVelocity(pin, link),
        };
        let kind = self.kind_of(base);
        let vector = self.note_vector(
            Order::Velocity,
            (kind, quantity, Some(route.claim)),
            route.from,
            (label, image),
        );
        self.act_read(Order::Velocity, vector);
        let speed = self.board.read(along, scale);
        let length = self.length_to(link, base, pin);
        let reason = self.reason(&[link]);
        let omega = self.board.quotient(speed, length, reason);
        self.omegas[link.0] = Some(omega);
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
    fn read_slip(
        &mut self,
        route: &Route<B>,
        target: Target,
        (slide, back): (usize, bool),
        (label, image): (Label, Point<B>),
        along: Mm<B>,
    ) {
        let pin = target.pin();
        let guide = self.mechanism.slides[slide].guide.link;
        let scale = self.polygon_scale(Order::Velocity);
        let read = self.board.read(along, scale);
        // Read from the guide's point to the rider: against the ray where it was drawn backwards.
        let speed = if back { self.board.opposite(read) } else { read };
        self.slips[slide] = Some(speed);
        let (tail, head) = if back { ((label, image), route.from) } else { (route.from, (label, image)) };
        let quantity = match (target, back) {
            // A yoke on a fixed guide: its own velocity is the sliding velocity.
            (Target::Under(pin, link), false) if guide == LinkId::FRAME => {
                Quantity::CoincidentVelocity(pin, link)
            }
            _ if guide == LinkId::FRAME => Quantity::Velocity(pin),
            (Target::Under(..), false) => Quantity::Slip(self.riding_point(slide, pin), guide),
            _ => Quantity::Slip(pin, guide),
        };
        let kind = if guide == LinkId::FRAME { VectorKind::Absolute } else { VectorKind::Sliding };
        let vector = self.note_vector(Order::Velocity, (kind, quantity, Some(route.claim)), tail, head);
        self.act_read(Order::Velocity, vector);
        self.note_part(Quantity::Slip(self.riding_point(slide, pin), guide), tail.1, head.1);
    }

    /// The point of a sliding pair's rider by which its sliding is named.
    pub(super) fn riding_point(&self, slide: usize, pin: PointId) -> PointId {
        match self.mechanism.slides[slide].rider {
            Rider::Pin { point, .. } => point,
            Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied().unwrap_or(pin),
        }
    }

    /// The distance of a point from a link's pin: the link's own length, or measured where the point is not
    /// the link's.
    pub(super) fn length_to(&mut self, link: LinkId, base: PointId, point: PointId) -> Amount<B> {
        if self.mechanism.link(link).points.contains(&point) {
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
    pub(super) fn measured(&mut self, from: PointId, to: PointId) -> Amount<B> {
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
                let along = match order {
                    Order::Velocity => self.slips[index],
                    _ => self.sliding_accelerations[index],
                };
                if let Some(along) = along {
                    let radius = self.board.amount(radius);
                    let reason = self.reason(&[slide.guide.link]);
                    let turn = self.board.quotient(along, radius, reason);
                    rate = self.board.sum(rate, turn);
                }
            } else if slide.guide.link == LinkId::FRAME && order == Order::Velocity {
                self.act(Act::Calculate(Calculation::Translation { link: block }));
            }
            self.set_rate(order, block, rate);
        }
    }

    /// ω or ε of links that slide without turning: that of the link they slide on.
    pub(super) fn rates_by_riding(&mut self, order: Order, kind: GroupKind) {
        match kind {
            GroupKind::Rpr { lever, rod: Some(rod), .. } => {
                let rate = self.rate(order, lever);
                self.set_rate(order, rod, rate);
            }
            GroupKind::Yoke { link, ride, .. } => {
                let carrier = self.mechanism.slides[ride].guide.link;
                let rate = self.rate(order, carrier);
                self.translates[link.0] = self.translates[carrier.0];
                self.set_rate(order, link, rate);
            }
            _ => {}
        }
    }

    pub(super) fn set_rate(&mut self, order: Order, link: LinkId, rate: Amount<B>) {
        match order {
            Order::Acceleration => self.alphas[link.0] = Some(rate),
            _ => self.omegas[link.0] = Some(rate),
        }
    }

    /// The vector from the pole to an image.
    pub(super) fn absolute_vector(
        &mut self,
        order: Order,
        quantity: Quantity,
        label: Label,
        image: Point<B>,
    ) {
        let pole = self.board.origin();
        let vector = self.note_vector(
            order,
            (VectorKind::Absolute, quantity, None),
            (Label::Pole, pole),
            (label, image),
        );
        self.act_read(order, vector);
    }

    fn found_velocity(&mut self, point: PointId) -> Term {
        let image = self.image(Order::Velocity, point).value();
        let magnitude = libm::hypot(image[0], image[1]) * self.scales.velocity;
        Term {
            quantity: Quantity::Velocity(point),
            magnitude: Some(magnitude),
            direction: Some(TermDirection::Found),
        }
    }

    /// V_B = V_A + V_BA, by both routes; for a lever V_A = V_A4 + V_AA4, with the pin's known velocity on
    /// the left.
    fn velocity_equation(&mut self, target: Target, unknowns: [Unknown; 2]) -> Equation {
        let route = |d: &mut Self, unknown: Unknown| -> Vec<Term> {
            let unknown_term = |quantity: Quantity, claim: Claim| Term {
                quantity,
                magnitude: None,
                direction: Some(TermDirection::Claim(claim)),
            };
            match unknown {
                Unknown::Turn { base, to, .. } => {
                    let claim = Claim::Perpendicular(Reference::Points(base, to));
                    let quantity = match target {
                        Target::Pin(pin) => d.relative_velocity(pin, base),
                        Target::Under(pin, link) => Quantity::CoincidentVelocity(pin, link),
                    };
                    let mut terms = Vec::new();
                    if !d.mechanism.is_fixed(base) {
                        terms.push(d.found_velocity(base));
                    }
                    terms.push(unknown_term(quantity, claim));
                    terms
                }
                Unknown::Roll { roll, wheel, centre } => {
                    let body = d.rolled_on(roll, wheel);
                    let (quantity, _) = d.rolling_velocity(roll, wheel, centre);
                    let mut terms = Vec::new();
                    let claim = match d.other_centre(roll, wheel) {
                        Some(other) => {
                            if !d.mechanism.is_fixed(other) {
                                terms.push(d.found_velocity(other));
                            }
                            Claim::Perpendicular(Reference::Points(other, centre))
                        }
                        None => {
                            if body != LinkId::FRAME {
                                terms.push(d.found_under(centre, body));
                            }
                            d.rolling_direction(roll, wheel, centre).1
                        }
                    };
                    terms.push(unknown_term(quantity, claim));
                    terms
                }
                Unknown::Slide { slide, back } => {
                    let guide = d.mechanism.slides[slide].guide.link;
                    let claim = Claim::Parallel(Reference::Guide(slide));
                    let pin = target.pin();
                    match (guide == LinkId::FRAME, target, back) {
                        (true, Target::Under(pin, link), false) => {
                            vec![unknown_term(Quantity::CoincidentVelocity(pin, link), claim)]
                        }
                        (true, ..) => vec![unknown_term(Quantity::Velocity(pin), claim)],
                        (false, _, true) => vec![unknown_term(Quantity::Slip(pin, guide), claim)],
                        (false, _, false) => {
                            let under = d.found_under(pin, guide);
                            vec![under, unknown_term(Quantity::Slip(pin, guide), claim)]
                        }
                    }
                }
            }
        };
        if let Target::Under(pin, _) = target {
            let mut right = route(self, unknowns[0]);
            right.extend(route(self, unknowns[1]));
            return Equation { left: vec![self.found_velocity(pin)], right };
        }
        // The route from the frame, if there is one, stands on the left.
        let from_frame = |d: &Self, unknown: Unknown| match unknown {
            Unknown::Turn { base, .. } => d.mechanism.is_fixed(base),
            Unknown::Slide { slide, .. } => d.mechanism.slides[slide].guide.link == LinkId::FRAME,
            Unknown::Roll { roll, wheel, .. } => d.rolled_on(roll, wheel) == LinkId::FRAME,
        };
        let [a, b] = if from_frame(self, unknowns[1]) { [unknowns[1], unknowns[0]] } else { unknowns };
        Equation { left: route(self, a), right: route(self, b) }
    }

    fn found_under(&mut self, pin: PointId, link: LinkId) -> Term {
        let image = self.image_under(Order::Velocity, pin, link).value();
        Term {
            quantity: Quantity::CoincidentVelocity(pin, link),
            magnitude: Some(libm::hypot(image[0], image[1]) * self.scales.velocity),
            direction: Some(TermDirection::Found),
        }
    }

    /// The image of the point of a solved link under a pin: V = ω l from a known image of the link.
    pub(super) fn image_under(&mut self, order: Order, pin: PointId, link: LinkId) -> Point<B> {
        if link == LinkId::FRAME {
            return self.board.origin();
        }
        if self.mechanism.link(link).points.contains(&pin) {
            return self.image(order, pin);
        }
        let known = self.coincident.iter().find(|c| c.order == order && c.pin == pin && c.link == link);
        if let Some(known) = known {
            return known.image;
        }
        let image = match self.base_for(order, pin, link) {
            Some(base) if order == Order::Acceleration => {
                self.board.purpose("acceleration of a point under a pin");
                self.acceleration_about(link, base, pin)
            }
            Some(base) => {
                self.board.purpose("velocity of a point under a pin");
                self.velocity_about(link, base, pin)
            }
            None => self.translated_image(order, link),
        };
        self.note_under(order, pin, link, image);
        let label = self.label_under(pin, link);
        let quantity = match order {
            Order::Acceleration => Quantity::CoincidentAcceleration(pin, link),
            _ => Quantity::CoincidentVelocity(pin, link),
        };
        self.absolute_vector(order, quantity, label, image);
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

    /// The image of a link of which no point has one: that under the pin by which it was solved. Only a link
    /// that translates is solved without an image of its own.
    fn translated_image(&mut self, order: Order, link: LinkId) -> Point<B> {
        match self.coincident.iter().find(|c| c.order == order && c.link == link) {
            Some(known) => known.image,
            None => self.board.origin(),
        }
    }

    /// V = ω l about a point whose image is known, laid off perpendicular in the sense of ω.
    pub(super) fn velocity_about(&mut self, link: LinkId, base: PointId, point: PointId) -> Point<B> {
        let scale = self.polygon_scale(Order::Velocity);
        let omega = self.rate(Order::Velocity, link);
        let length = self.length_to(link, base, point);
        let speed = self.board.product(omega, length);
        let quantity = if self.mechanism.link(link).points.contains(&point) {
            self.relative_velocity(point, base)
        } else {
            Quantity::CoincidentVelocity(point, link)
        };
        let value = speed.value().abs();
        self.act(Act::Calculate(Calculation::Speed {
            quantity,
            link,
            ends: [base, point],
            omega: omega.value(),
            length: length.value(),
            value,
        }));
        let square = self.square_to(link, base, point);
        let mm = self.board.to_paper(speed, scale);
        let from = self.image(Order::Velocity, base);
        self.board.lay_off(from, square, mm)
    }

    /// Images of the further points of the group's links.
    fn further_velocities(&mut self, step: &GroupStep, kind: GroupKind) {
        for &(link, point) in &step.points {
            self.board.purpose("velocity image of a further point");
            let image = match (kind, main_base(kind, link)) {
                (GroupKind::Rpr { lever, base, .. }, _) if link == lever => {
                    self.velocity_about(link, base, point)
                }
                (GroupKind::Rpr { pin, .. }, _) => self.velocity_about(link, pin, point),
                (GroupKind::Yoke { pin, .. }, _) => self.riding_image(Order::Velocity, link, pin, point),
                (_, Some((base, pin))) => match self.straight_ratio(link, base, pin, point) {
                    Some(ratio) => self.divide_image(Order::Velocity, (base, pin), point, ratio),
                    None => self.velocity_corner(link, (base, pin), point),
                },
                (_, None) => continue,
            };
            self.note_image(Order::Velocity, point, image);
            let label = self.label(point);
            self.absolute_vector(Order::Velocity, Quantity::Velocity(point), label, image);
        }
    }

    /// A point of a link that slides without turning: the image under its pin, where the link it slides on
    /// does not turn either; else V = ω l from there.
    pub(super) fn riding_image(
        &mut self,
        order: Order,
        link: LinkId,
        pin: PointId,
        point: PointId,
    ) -> Point<B> {
        let from = self.image_under(order, pin, link);
        let omega = self.rate(Order::Velocity, link);
        let alpha = self.rate(Order::Acceleration, link);
        if omega.value() == 0.0 && (order == Order::Velocity || alpha.value() == 0.0) {
            self.act(Act::SameImage { label: self.label(point), with: self.label_under(pin, link) });
            return from;
        }
        let square = self.square_to(link, pin, point);
        let length = self.measured(pin, point);
        let scale = self.polygon_scale(order);
        if order == Order::Velocity {
            let speed = self.board.product(omega, length);
            let mm = self.board.to_paper(speed, scale);
            return self.board.lay_off(from, square, mm);
        }
        let outward = self.outward(link, pin, point);
        let inward = self.board.reverse(outward);
        let speed = self.board.product(omega, length);
        let normal = self.board.product(omega, speed);
        let tangential = self.board.product(alpha, length);
        let mm = self.board.to_paper(normal, scale);
        let foot = self.board.lay_off(from, inward, mm);
        let mm = self.board.to_paper(tangential, scale);
        self.board.lay_off(foot, square, mm)
    }

    /// base→point : base→pin on a straight link, signed; `None` for other links.
    pub(super) fn straight_ratio(
        &mut self,
        link: LinkId,
        base: PointId,
        pin: PointId,
        point: PointId,
    ) -> Option<Ratio<B>> {
        self.is_straight(link).then(|| self.proportions(link, base, pin, point)[0])
    }

    /// Divides an image line as the link is divided.
    pub(super) fn divide_image(
        &mut self,
        order: Order,
        (base, pin): (PointId, PointId),
        point: PointId,
        ratio: Ratio<B>,
    ) -> Point<B> {
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

    /// A corner of the image triangle, by perpendiculars to two sides.
    fn velocity_corner(&mut self, link: LinkId, (base, pin): (PointId, PointId), point: PointId) -> Point<B> {
        if !self.crosses_well(base, pin, point) {
            return self.similar_image(Order::Velocity, link, (base, pin), point);
        }
        let arms = [self.velocity_arm(link, base, point), self.velocity_arm(link, pin, point)];
        for arm in &arms {
            self.act(Act::DrawRay { from: arm.from.0, claim: arm.claim });
        }
        let reason = self.reason(&[link]);
        let meet = self.board.meet_lines(arms[0].ray, arms[1].ray, reason);
        self.act(Act::MarkMeet { label: self.label(point), crossing: meet.crossing });
        for arm in &arms {
            self.note_ray(Order::Velocity, arm.from.1, meet.at, arm.claim);
        }
        meet.at
    }

    /// A corner of an image, by the figure similar to the link.
    pub(super) fn similar_image(
        &mut self,
        order: Order,
        link: LinkId,
        (base, pin): (PointId, PointId),
        point: PointId,
    ) -> Point<B> {
        let [along, across] = self.proportions(link, base, pin, point);
        let ends = [self.image(order, base), self.image(order, pin)];
        let base_labels = [self.label(base), self.label(pin)];
        self.act(Act::CompleteImage { label: self.label(point), link, base: base_labels });
        self.board.similar(ends, along, across)
    }
}
