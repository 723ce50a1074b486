//! Groups of two unknowns, at the order of velocity and at that of acceleration alike: from two known images
//! run two lines of unknown length; they meet in the sought image, and what is read along them are the
//! unknowns (`s000-ch3a` 2.3 and 2.4). What is laid off before a line begins, and what its length is called,
//! is in `velocity.rs` and `acceleration.rs`.

use crate::board::{Direction, Line, Mm, Point};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::{Drive, Group, GroupKind, Hold, Lead, Ram, Target, Unknown};
use crate::mechanism::{Guide, LinkId, Path, PointId, Rider, Roll};
use crate::plan::GroupStep;

use super::construction::{
    Act, Calculation, Claim, Equation, Label, Reference, Term, TermDirection, Vector, VectorKind,
};
use super::draughtsman::Draughtsman;

/// A way to the sought image: where its known parts end, and from there a line of unknown length.
pub(super) struct Route {
    pub(super) foot: (Label, Point),
    pub(super) ray: Line,
    pub(super) claim: Claim,
    pub(super) unknown: Unknown,
}

/// One route as a sum of vectors.
struct Side {
    known: Vec<Term>,
    /// What is drawn along the route, or backwards along it.
    unknown: Vec<Term>,
    back: bool,
    /// What is known and laid off backwards: it stands on the other side.
    across: Vec<Term>,
}

impl Draughtsman<'_> {
    /// The solved link of a sliding pair; none where a pin of one is the rider.
    pub(super) fn solved_side(&self, slide: usize, back: bool) -> Option<LinkId> {
        let slide = self.mechanism.slides[slide];
        match slide.rider {
            _ if !back => Some(slide.guide.link),
            Rider::Link { link, .. } => Some(link),
            Rider::Pin { .. } => None,
        }
    }

    /// From where the route along a sliding pair starts: the image of the solved side's point.
    pub(super) fn slide_start(
        &mut self,
        order: Order,
        (slide, back): (usize, bool),
        pin: PointId,
    ) -> (Label, Point) {
        match self.solved_side(slide, back) {
            Some(link) => (self.label_under(pin, link), self.image_under(order, pin, link)),
            None => (self.label(pin), self.image(order, pin)),
        }
    }

    /// The known parts of a route, laid off, and its line; `index` counts the feet of both routes.
    fn route(&mut self, order: Order, unknown: Unknown, target: Target, index: &mut u8) -> Route {
        let pin = target.pin();
        let first = *index;
        *index += match unknown {
            // Feet of a driven lever bear its number.
            Unknown::Reach { .. } => 0,
            _ if order == Order::Velocity => 0,
            Unknown::Turn { .. } | Unknown::Roll { .. } | Unknown::Spin { .. } => 1,
            Unknown::Carried { .. } => 2,
            Unknown::Contact { .. } => 0,
            Unknown::Slide { slide, .. } => match self.mechanism.slides[slide].guide {
                Guide { path: Path::Arc { .. }, link } => 1 + u8::from(!self.translates[link.0]),
                Guide { link, .. } => u8::from(!self.translates[link.0]),
            },
        };
        let route = match (order, unknown) {
            (_, Unknown::Carried { hold, back, link, pin: other }) => {
                self.carried_route(order, (hold, back), link, [other, pin], first)
            }
            (_, Unknown::Contact { roll, body }) => self.contact_route(order, roll, body),
            (_, Unknown::Spin { roll, wheel, centre }) => {
                self.spin_route(order, (roll, wheel, centre), first)
            }
            (Order::Acceleration, Unknown::Turn { link, base, to }) => {
                self.acceleration_arm(link, base, to, first)
            }
            (Order::Acceleration, Unknown::Roll { roll, wheel, centre, back }) => {
                self.acceleration_roll((roll, wheel, centre), back, first)
            }
            (Order::Acceleration, Unknown::Slide { slide, back }) => {
                // Feet behind a pin's image bear no link's number, so they are counted by themselves.
                let behind = back && self.solved_side(slide, back).is_none();
                self.acceleration_slide(slide, back, pin, if behind { 1 } else { first })
            }
            (_, Unknown::Turn { link, base, to }) => self.velocity_arm(link, base, to),
            (_, Unknown::Reach { ram, to }) => self.reach_route(order, ram, to),
            (_, Unknown::Roll { roll, wheel, centre, back }) => {
                self.velocity_roll((roll, wheel, centre), back)
            }
            (_, Unknown::Slide { slide, back }) => self.velocity_slide(slide, back, pin),
        };
        self.ray_as_drawn(order, route)
    }

    /// The line of an open constraint from its known end, for a trial.
    pub(super) fn closing_line(&mut self, order: Order, unknown: Unknown, end: PointId) -> Line {
        self.route(order, unknown, Target::Pin(end), &mut 1).ray
    }

    /// Reads what an open constraint has become when its end's image is known.
    pub(super) fn read_closing(
        &mut self,
        order: Order,
        unknown: Unknown,
        target: Target,
        (label, image): (Label, Point),
    ) {
        let route = self.route(order, unknown, target, &mut 1);
        let [along, _] = self.board.square_off(route.ray, image);
        self.note_ray(order, route.foot.1, image, route.claim);
        self.read_route(order, &route, target, (label, image), along);
    }

    /// Reads the unknown along a route.
    fn read_route(&mut self, order: Order, route: &Route, target: Target, head: (Label, Point), along: Mm) {
        match (order, route.unknown) {
            (Order::Acceleration, Unknown::Turn { link, base, .. }) => {
                self.read_alpha(route, target, (link, base), head, along);
            }
            (_, Unknown::Turn { link, base, .. }) => {
                self.read_omega(route, target, (link, base), head, along);
            }
            (Order::Acceleration, Unknown::Reach { ram: Ram { lever, base, .. }, to }) => {
                self.read_alpha(route, Target::Under(to, lever), (lever, base), head, along);
            }
            (_, Unknown::Reach { ram: Ram { lever, base, .. }, to }) => {
                self.read_omega(route, Target::Under(to, lever), (lever, base), head, along);
            }
            (Order::Acceleration, Unknown::Slide { slide, back }) => {
                self.read_sliding(route, target, (slide, back), head, along);
            }
            (_, Unknown::Slide { slide, back }) => {
                self.read_slip(route, target, (slide, back), head, along);
            }
            (_, Unknown::Roll { roll, wheel, centre, back }) => {
                if order == Order::Velocity {
                    let scale = self.polygon_scale(order);
                    let read = self.board.read(along, scale);
                    // Read from the body's point to the centre: against the ray where it was drawn backwards.
                    let speed = if back { self.board.opposite(read) } else { read };
                    self.rolling_speeds[roll] = Some(speed);
                }
                let (quantity, kind) = self.rolling_unknown(order, (roll, wheel, centre), route.foot.0);
                let [tail, head] = if back { [head, route.foot] } else { [route.foot, head] };
                let vector = self.note_vector(order, (kind, quantity, Some(route.claim)), tail, head);
                self.act_read(order, vector);
            }
            (Order::Acceleration, Unknown::Contact { roll, body }) => {
                self.read_contact_normal((roll, body), route.claim, head, route.foot);
            }
            // Rolling without slip: the velocities are one, and of a driven wheel nothing is unknown. The
            // sliding of another pin is read when its own image stands.
            (_, Unknown::Contact { .. } | Unknown::Spin { .. } | Unknown::Carried { .. }) => {}
        }
    }

    /// From the image of a driven lever's base what is known of the driven pin: of velocities how it is driven, of
    /// accelerations Aⁿ = ω² l of the lever's point under it, Coriolis, and how it is driven. From their end the line of what
    /// the lever's turning leaves unknown, square to the line of base and pin.
    fn reach_route(&mut self, order: Order, ram: Ram, to: PointId) -> Route {
        let Ram { lever, base, slide, input } = ram;
        let back = ram.slides(self.mechanism);
        let (rider, guide) = (self.riding_point(slide, to), self.mechanism.slides[slide].guide.link);
        let given = self.driven_rate(order, Drive::Input(input));
        let scale = self.polygon_scale(order);
        let foot = |index: u8| Label::Foot { point: to, link: Some(lever), index };
        let mut start = (self.label(base), self.image(order, base));
        let mut index = 1;
        let tangent = self.tangent(slide, to);
        let quantity = match order {
            Order::Acceleration => {
                start = (foot(index), self.lay_off_reach(ram, to, foot(index)));
                start = self.sliding_parts((slide, back), (to, tangent), start, [foot(index + 1); 2]);
                index += 2;
                Quantity::SlipAcceleration(rider, guide)
            }
            _ => Quantity::Slip(rider, guide),
        };
        let along = tangent.0;
        let mm = self.board.to_paper(given, scale);
        let way = if back { self.board.reverse(along) } else { along };
        let at = self.lay_off_vector(quantity, start.1, way, mm);
        self.motion_mut(order).slidings[slide] = Some(given);
        let end = (foot(index), at);
        let [tail, head] = if back { [end, start] } else { [start, end] };
        let claim = Some(Claim::Parallel(Reference::Guide(slide)));
        let vector = self.note_vector(order, (VectorKind::Sliding, quantity, claim), tail, head);
        self.act(Act::LayOffVector { vector, value: given.value().abs(), mm: mm.value().abs() });
        self.note_foot(order, end.0, at);
        self.note_part(quantity, tail.1, head.1);
        let along = self.square_to(lever, base, to);
        let claim = Claim::Perpendicular(Reference::Points(base, to));
        self.act(Act::DrawRay { from: end.0, claim });
        Route { foot: end, ray: Line { through: at, along }, claim, unknown: Unknown::Reach { ram, to } }
    }

    /// Aⁿ = ω² l of the point of a driven lever under the driven pin, laid off from the image of its base.
    fn lay_off_reach(&mut self, ram: Ram, to: PointId, label: Label) -> Point {
        let Ram { lever, base, .. } = ram;
        let order = Order::Acceleration;
        let length = self.length_to(lever, base, to);
        let omega = self.rate(Order::Velocity, lever);
        let speed = self.board.product(omega, length);
        let normal = self.board.product(omega, speed);
        let quantity = Quantity::CoincidentNormal(to, lever);
        self.act(Act::Calculate(Calculation::Normal {
            quantity,
            velocity: Quantity::CoincidentVelocity(to, lever),
            ends: [base, to],
            speed: speed.value().abs(),
            length: length.value(),
            value: normal.value(),
        }));
        let outward = self.outward(lever, base, to);
        let inward = self.board.reverse(outward);
        let scale = self.polygon_scale(order);
        let mm = self.board.to_paper(normal, scale);
        let from = self.image(order, base);
        let at = self.lay_off_vector(quantity, from, inward, mm);
        let claim = Some(Claim::Parallel(Reference::Points(base, to)));
        let ends = [(self.label(base), from), (label, at)];
        let vector = self.note_vector(order, (VectorKind::Normal, quantity, claim), ends[0], ends[1]);
        self.act(Act::LayOffVector { vector, value: normal.value(), mm: mm.value() });
        self.note_foot(order, label, at);
        self.note_part(quantity, from, at);
        at
    }

    /// From the image of the solved body's contact point a line along the common normal.
    fn contact_route(&mut self, order: Order, roll: usize, body: LinkId) -> Route {
        let unknown = Unknown::Contact { roll, body };
        let other = self.rolled_on(roll, body);
        let foot = (self.contact_label(roll, other), self.contact_image(order, roll, other));
        let (along, claim) = self.common_normal(roll);
        self.act(Act::DrawRay { from: foot.0, claim });
        Route { foot, ray: Line { through: foot.1, along }, claim, unknown }
    }

    /// From the image of the guide's point under another pin of a driven link, after the known parts of its
    /// sliding, the parts that the link's rotation gives; from their end a line along that guide.
    fn carried_route(
        &mut self,
        order: Order,
        (hold, back): (Hold, bool),
        link: LinkId,
        [other, pin]: [PointId; 2],
        index: u8,
    ) -> Route {
        let (start, along, claim) = match (hold, order) {
            (Hold::Slide(slide), Order::Acceleration) => {
                let (start, along) = self.sliding_foot(slide, back, other, 1);
                (start, along, Claim::Parallel(Reference::Guide(slide)))
            }
            (Hold::Slide(slide), _) => {
                let (along, _) = self.tangent(slide, other);
                let start = self.slide_start(order, (slide, back), other);
                (start, along, Claim::Parallel(Reference::Guide(slide)))
            }
            (Hold::Contact { roll, wheel }, _) => {
                let route = match order {
                    Order::Acceleration => self.acceleration_roll((roll, wheel, other), back, 1),
                    _ => self.velocity_roll((roll, wheel, other), back),
                };
                // Its line is drawn from where the turning has led to.
                self.take_back_act();
                (route.foot, route.ray.along, route.claim)
            }
            (Hold::Rod { rod, base }, _) => {
                let route = match order {
                    Order::Acceleration => self.acceleration_arm(rod, base, other, 1),
                    _ => self.velocity_arm(rod, base, other),
                };
                self.take_back_act();
                (route.foot, route.ray.along, route.claim)
            }
            (Hold::Ram(ram), _) => {
                let route = self.reach_route(order, ram, other);
                self.take_back_act();
                (route.foot, route.ray.along, route.claim)
            }
        };
        let foot = self.lay_off_turn(order, link, [other, pin], start, (index, None));
        self.act(Act::DrawRay { from: foot.0, claim });
        let unknown = Unknown::Carried { hold, back, link, pin: other };
        Route { foot, ray: Line { through: foot.1, along }, claim, unknown }
    }

    /// What a link's turning gives one of its points against another: V, Aⁿ, Aᵗ. Where one of them is that under a pin of
    /// another link, it is not what the pin has against the other.
    fn turned_between(&self, link: LinkId, point: PointId, base: PointId) -> [Quantity; 3] {
        let own = &self.mechanism.link(link).points;
        if own.contains(&point) && own.contains(&base) {
            [
                Quantity::RelativeVelocity(point, base),
                Quantity::RelativeNormal(point, base),
                Quantity::RelativeTangential(point, base),
            ]
        } else {
            [
                Quantity::TurningVelocity(point, base, link),
                Quantity::TurningNormal(point, base, link),
                Quantity::TurningTangential(point, base, link),
            ]
        }
    }

    /// Lays off what the rotation of a link of known rates gives between two of its points: V = ω l, or
    /// Aⁿ = ω² l and Aᵗ = ε l. Feet count from `index`; the last may be an image.
    pub(super) fn lay_off_turn(
        &mut self,
        order: Order,
        link: LinkId,
        [base, point]: [PointId; 2],
        start: (Label, Point),
        (index, last): (u8, Option<Label>),
    ) -> (Label, Point) {
        let second = order == Order::Acceleration;
        let scale = self.polygon_scale(order);
        let line = Reference::Points(base, point);
        let length = self.length_to(link, base, point);
        // Where the two may be one place no line leads from the one to the other.
        let lines = if self.may_touch_at_joint(link, [base, point]) {
            None
        } else {
            let outward = self.outward(link, base, point);
            Some((outward, self.board.quarter_turn(outward)))
        };
        let mut parts = Vec::new();
        let [velocity, of_normal, of_tangential] = self.turned_between(link, point, base);
        if second {
            let omega = self.rate(Order::Velocity, link);
            let speed = self.board.product(omega, length);
            let normal = self.board.product(omega, speed);
            let quantity = of_normal;
            self.act(Act::Calculate(Calculation::Normal {
                quantity,
                velocity,
                ends: [base, point],
                speed: speed.value().abs(),
                length: length.value(),
                value: normal.value(),
            }));
            let by = match lines {
                Some((outward, _)) => Turned::Along(self.board.reverse(outward)),
                None => {
                    let square = self.board.product(omega, omega);
                    let inward = self.way_times(square, [point, base]);
                    Turned::By(inward.map(|part| self.board.to_paper(part, scale)))
                }
            };
            parts.push((VectorKind::Normal, quantity, Claim::Parallel(line), by, normal));
        }
        let rate = self.rate(order, link);
        let part = self.board.product(rate, length);
        let (kind, quantity) =
            if second { (VectorKind::Tangential, of_tangential) } else { (VectorKind::Relative, velocity) };
        self.act_turning(order, quantity, link, [base, point], [rate, length, part]);
        let by = match lines {
            Some((_, square)) => Turned::Along(square),
            None => Turned::By(self.square_parts(rate, [base, point], order)),
        };
        parts.push((kind, quantity, Claim::Perpendicular(line), by, part));
        let count = parts.len();
        let mut foot = start;
        for (place, (kind, quantity, claim, by, amount)) in parts.into_iter().enumerate() {
            let mm = self.board.to_paper(amount, scale);
            let at = match by {
                Turned::Along(direction) => self.lay_off_vector(quantity, foot.1, direction, mm),
                Turned::By(parts) => self.board.moved(foot.1, parts),
            };
            let next = index + u8::from(place > 0);
            let here = last.filter(|_| place + 1 == count);
            let label = here.unwrap_or(Label::Foot { point, link: None, index: next });
            let vector = self.note_vector(order, (kind, quantity, Some(claim)), foot, (label, at));
            self.act(Act::LayOffVector { vector, value: amount.value().abs(), mm: mm.value().abs() });
            self.note_part(quantity, foot.1, at);
            if here.is_none() {
                self.note_foot(order, label, at);
            }
            foot = (label, at);
        }
        foot
    }

    /// The other pins of a driven link: their images, and what their sliding is.
    pub(super) fn other_pins(&mut self, order: Order, kind: GroupKind) {
        let (link, point, under) = match kind {
            GroupKind::DrivenBar { link, point, under, .. } => (link, point, under),
            GroupKind::DrivenRack { link, centre, .. } => (link, centre, [true; 2]),
            _ => return,
        };
        let unknowns = kind.unknowns(self.mechanism).into_iter().flat_map(|(_, unknowns)| unknowns);
        for (found, is_under) in unknowns.zip(under) {
            let Unknown::Carried { hold, back, pin, .. } = found else { continue };
            let (target, head) = if is_under {
                let image = self.image_under(order, pin, link);
                (Target::Under(pin, link), (self.label_under(pin, link), image))
            } else {
                let image = match (hold, order) {
                    // Its first foot is the end of the rod's own part.
                    (Hold::Rod { .. }, Order::Acceleration) => {
                        self.acceleration_about_from(link, point, pin, 2)
                    }
                    _ => self.image_about(order, link, point, pin),
                };
                let image = self.note_image(order, pin, image);
                if let Hold::Rod { rod, base } = hold {
                    self.read_rod(order, (rod, base), pin, image);
                    continue;
                }
                self.absolute_of(order, pin, image);
                (Target::Pin(pin), (self.label(pin), image))
            };
            let loud = !std::mem::replace(&mut self.silent, true);
            self.read_closing(order, hold.unknown(back, pin), target, head);
            self.silent = !loud;
        }
    }

    /// Reads how the rod at another pin of a driven link turns, along the line that its image lies on; the parts of it that
    /// are known were laid off on the way to the first pin.
    fn read_rod(&mut self, order: Order, (rod, base): (LinkId, PointId), pin: PointId, image: Point) {
        let label = self.label(pin);
        let turn = Unknown::Turn { link: rod, base, to: pin };
        let target = Target::Pin(pin);
        let loud = !std::mem::replace(&mut self.silent, true);
        let route = self.route(order, turn, target, &mut 1);
        self.silent = !loud;
        let [along, _] = self.board.square_off(route.ray, image);
        let along = if self.departures.is_empty() { along } else { self.length_along(&route, image, along) };
        self.read_route(order, &route, target, (label, image), along);
        self.absolute_of(order, pin, image);
        if order == Order::Acceleration && !self.mechanism.is_fixed(base) {
            self.whole_acceleration(pin, base, image);
        }
    }

    pub(super) fn contact_label(&self, roll: usize, body: LinkId) -> Label {
        self.label_under(self.contact_of(roll), body)
    }

    /// The line from a wheel's centre to its contact point.
    pub(super) fn common_normal(&mut self, roll: usize) -> (crate::board::Direction, Claim) {
        let (wheel, centre) = match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => (links[1], centres[1]),
            Roll::Line { wheel, centre, .. } => (wheel, centre),
        };
        let contact = self.contact_of(roll);
        let along = self.outward(wheel, centre, contact);
        (along, Claim::Parallel(Reference::Points(centre, contact)))
    }

    /// From the image of the solved body's contact point the part ω r or ε r of the driven wheel's centre
    /// against it.
    pub(super) fn spin_part(
        &mut self,
        order: Order,
        roll: usize,
        (wheel, centre): (LinkId, PointId),
        head: Label,
    ) -> Point {
        let other = self.rolled_on(roll, wheel);
        let start = (self.contact_label(roll, other), self.contact_image(order, roll, other));
        let contact = self.contact_of(roll);
        let (quantity, kind) = match order {
            Order::Acceleration => (Quantity::RelativeTangential(centre, contact), VectorKind::Tangential),
            _ if other == LinkId::FRAME => (Quantity::Velocity(centre), VectorKind::Absolute),
            _ => (Quantity::RelativeVelocity(centre, contact), VectorKind::Relative),
        };
        let (at, [part, mm]) = self.lay_off_spin(order, quantity, wheel, [contact, centre], start.1);
        let across = Claim::Perpendicular(Reference::Points(centre, contact));
        let vector = self.note_vector(order, (kind, quantity, Some(across)), start, (head, at));
        self.act(Act::LayOffVector { vector, value: part, mm });
        at
    }

    /// From this point, what a driven wheel's rotation gives of its centre about its contact, ω r or α r square to the
    /// radius: where that ends, with its amount in SI units and in mm.
    pub(super) fn lay_off_spin(
        &mut self,
        order: Order,
        quantity: Quantity,
        wheel: LinkId,
        [contact, centre]: [PointId; 2],
        from: Point,
    ) -> (Point, [f64; 2]) {
        let (rate, radius) = (self.rate(order, wheel), self.length_to(wheel, centre, contact));
        let part = self.board.product(rate, radius);
        self.act_turning(order, quantity, wheel, [contact, centre], [rate, radius, part]);
        // Seen from the contact point the centre lies opposite to where the contact lies from the centre.
        let back = self.square_to(wheel, centre, contact);
        let square = self.board.reverse(back);
        let scale = self.polygon_scale(order);
        let mm = self.board.to_paper(part, scale);
        let at = self.lay_off_vector(quantity, from, square, mm);
        (at, [part.value().abs(), mm.value().abs()])
    }

    /// From the end of the part that a driven wheel's rotation gives, a line along the common normal.
    fn spin_route(
        &mut self,
        order: Order,
        (roll, wheel, centre): (usize, LinkId, PointId),
        index: u8,
    ) -> Route {
        let label = Label::Foot { point: centre, link: None, index };
        let at = self.spin_part(order, roll, (wheel, centre), label);
        self.note_foot(order, label, at);
        let (along, claim) = self.common_normal(roll);
        self.act(Act::DrawRay { from: label, claim });
        let unknown = Unknown::Spin { roll, wheel, centre };
        Route { foot: (label, at), ray: Line { through: at, along }, claim, unknown }
    }

    /// Two lines of unknown length meet in the sought image.
    pub(super) fn dyad(&mut self, order: Order, step: &GroupStep, group: &Group) {
        let kind = group.kind;
        let Some((target, unknowns)) = kind.unknowns(self.mechanism) else { return };
        self.board.purpose(match order {
            Order::Acceleration => "acceleration image",
            _ => "velocity image",
        });
        let links: Vec<LinkId> =
            group.links.iter().copied().filter(|&l| !self.mechanism.link(l).block).collect();
        self.step(order, &links, Vec::new());
        self.rates_by_riding(order, kind);
        // Of accelerations what turns about the frame is laid off first.
        let about_frame = |unknown: Unknown| {
            matches!(unknown, Unknown::Turn { base, .. } | Unknown::Reach { ram: Ram { base, .. }, .. }
                if self.mechanism.is_fixed(base))
        };
        let swapped = order == Order::Acceleration && !about_frame(unknowns[0]) && about_frame(unknowns[1]);
        let unknowns = if swapped { [unknowns[1], unknowns[0]] } else { unknowns };
        let mut index = 1;
        let routes = unknowns.map(|unknown| self.route(order, unknown, target, &mut index));
        let equation = self.equation_of(order, target, unknowns);
        self.equation(equation);
        let reason = self.reason(&links);
        let meet = self.board.meet_lines(routes[0].ray, routes[1].ray, reason);
        let (at, label) = match target {
            Target::Pin(pin) => (self.note_image(order, pin, meet.at), self.label(pin)),
            Target::Under(pin, link) => {
                (self.note_under(order, pin, link, meet.at), self.label_under(pin, link))
            }
        };
        self.act(Act::MarkMeet { label, crossing: meet.crossing });
        for (route, along) in routes.iter().zip(meet.along) {
            // Where the image stands elsewhere than the lines meet, its distance is measured.
            let along = if self.departures.is_empty() { along } else { self.length_along(route, at, along) };
            self.note_ray(order, route.foot.1, at, route.claim);
            self.read_route(order, route, target, (label, at), along);
        }
        let as_one: Vec<(LinkId, LinkId)> = match kind {
            GroupKind::Rpr { lever, rod: Some(rod), .. } => vec![(lever, rod)],
            GroupKind::Driven { holds, riders, .. } => {
                let pairs = holds.into_iter().zip(riders);
                pairs.filter_map(|(hold, rider)| Some((hold.ram()?.lever, rider?))).collect()
            }
            _ => Vec::new(),
        };
        for (lever, rod) in as_one {
            let rate = self.rate(order, lever);
            self.set_rate(order, rod, rate);
        }
        self.whole_vectors(order, target, unknowns, (label, at));
        self.other_pins(order, kind);
        self.further_images(order, step, kind);
    }

    /// The thick vectors to the found image: from the pole, and of accelerations from each moving base.
    fn whole_vectors(
        &mut self,
        order: Order,
        target: Target,
        unknowns: [Unknown; 2],
        (label, image): (Label, Point),
    ) {
        let quantity = match (order, target) {
            (Order::Acceleration, Target::Pin(pin)) => Quantity::Acceleration(pin),
            (Order::Acceleration, Target::Under(pin, link)) => Quantity::CoincidentAcceleration(pin, link),
            (_, Target::Pin(pin)) => Quantity::Velocity(pin),
            (_, Target::Under(pin, link)) => Quantity::CoincidentVelocity(pin, link),
        };
        let drawn = |v: &Vector| v.tail == Label::Pole && v.quantity == quantity;
        let is_drawn = self.leads_from_pole(order, label)
            && self.polygon(order).is_some_and(|p| p.vectors.iter().any(drawn));
        if !is_drawn {
            self.absolute_vector(order, quantity, label, image);
        }
        for unknown in unknowns {
            if let (Order::Acceleration, Unknown::Turn { base, .. }, Target::Pin(pin)) =
                (order, unknown, target)
                && !self.mechanism.is_fixed(base)
            {
                self.whole_acceleration(pin, base, image);
            }
        }
    }

    /// V_B = V_A + V_BA, by both routes; what is drawn backwards along its route stands with the other one,
    /// as in V_A = V_A4 + V_AA4, with the pin's known velocity on the left.
    fn equation_of(&mut self, order: Order, target: Target, unknowns: [Unknown; 2]) -> Equation {
        let from_frame = |d: &Self, unknown: Unknown| match (order, unknown) {
            (_, Unknown::Slide { slide, back }) => d.solved_side(slide, back) == Some(LinkId::FRAME),
            (Order::Acceleration, _) => false,
            (_, Unknown::Turn { base, .. } | Unknown::Reach { ram: Ram { base, .. }, .. }) => {
                d.mechanism.is_fixed(base)
            }
            (_, Unknown::Roll { roll, wheel, .. }) => d.rolled_on(roll, wheel) == LinkId::FRAME,
            (_, Unknown::Contact { .. } | Unknown::Spin { .. } | Unknown::Carried { .. }) => false,
        };
        let second_first = match target {
            Target::Under(..) => true,
            Target::Pin(_) => from_frame(self, unknowns[1]),
        };
        let [first, second] = unknowns.map(|unknown| self.side_of(order, target, unknown));
        let [mut left, mut right] = if second_first { [second, first] } else { [first, second] };
        let mut sides = [std::mem::take(&mut left.known), std::mem::take(&mut right.known)];
        sides[0].append(&mut right.across);
        sides[1].append(&mut left.across);
        for (side, own) in [(right, 1), (left, 0)] {
            sides[if side.back { 1 - own } else { own }].extend(side.unknown);
        }
        let [left, right] = sides;
        Equation { begins: 0, whole: None, left, right }
    }

    /// V_C = V_A + V_CA = V_B + V_CB, of a further point by the routes from two points of its link.
    fn corner_equation(
        &mut self,
        order: Order,
        unknowns: [Unknown; 2],
        point: PointId,
        begins: usize,
    ) -> Equation {
        let about_frame = |unknown: &Unknown| matches!(unknown, Unknown::Turn { base, .. } if self.mechanism.is_fixed(*base));
        let whole = (!unknowns.iter().any(about_frame)).then(|| sought_whole(order, point));
        let sides = unknowns.map(|unknown| self.side_of(order, Target::Pin(point), unknown));
        let [left, right] = sides.map(|side| side.known.into_iter().chain(side.unknown).collect());
        Equation { begins, whole, left, right }
    }

    /// V_B = V_A + …, where all that leads from the image of one point to that of another was known, and laid off since an
    /// act. Nothing is told of a part that was not laid off, nor of a sum of one.
    pub(super) fn known_sum(
        &mut self,
        order: Order,
        (point, first): (PointId, Term),
        parts: &[(Quantity, Claim)],
        begins: usize,
    ) {
        let laid = |&(quantity, claim): &(Quantity, Claim)| {
            self.laid_off(order, quantity, TermDirection::Claim(claim))
        };
        let parts: Vec<Term> = parts.iter().filter_map(laid).collect();
        if !parts.is_empty() {
            let (whole, right) = (sought_whole(order, point), [first].into_iter().chain(parts).collect());
            self.equation(Equation { begins, whole: None, left: vec![whole], right });
        }
    }

    /// A_B = Aⁿ_B + Aᵗ_B of a point that moves about nothing but a resting one.
    pub(super) fn parts_of_sum(&mut self, order: Order, point: PointId, parts: &[(Quantity, Claim)]) {
        let laid = |&(quantity, claim): &(Quantity, Claim)| {
            self.laid_off(order, quantity, TermDirection::Claim(claim))
        };
        let right: Vec<Term> = parts.iter().filter_map(laid).collect();
        let left = vec![sought_whole(order, point)];
        self.equation(Equation { begins: 0, whole: None, left, right });
    }

    /// A vector of the diagram that is known by now.
    pub(super) fn found(&mut self, quantity: Quantity, image: Point, order: Order) -> Term {
        let at = image.value();
        let si_per_mm = self.polygon_scale(order).si_per_mm;
        Term {
            quantity,
            magnitude: Some(libm::hypot(at[0], at[1]) * si_per_mm),
            direction: Some(TermDirection::Found),
        }
    }

    pub(super) fn found_image(&mut self, order: Order, point: PointId) -> Term {
        let image = self.image(order, point);
        let quantity = match order {
            Order::Acceleration => Quantity::Acceleration(point),
            _ => Quantity::Velocity(point),
        };
        self.found(quantity, image, order)
    }

    pub(super) fn found_under(&mut self, order: Order, pin: PointId, link: LinkId) -> Term {
        if self.mechanism.link(link).points.contains(&pin) {
            return self.found_image(order, pin);
        }
        let image = self.image_under(order, pin, link);
        let quantity = match order {
            Order::Acceleration => Quantity::CoincidentAcceleration(pin, link),
            _ => Quantity::CoincidentVelocity(pin, link),
        };
        self.found(quantity, image, order)
    }

    /// One route as a sum: what is known of it, and what is drawn along it.
    fn side_of(&mut self, order: Order, target: Target, unknown: Unknown) -> Side {
        let second = order == Order::Acceleration;
        let pin = target.pin();
        let mut known = Vec::new();
        let mut drawn = Vec::new();
        let mut across = Vec::new();
        let sought = |quantity: Quantity, claim: Claim| Term {
            quantity,
            magnitude: None,
            direction: Some(TermDirection::Claim(claim)),
        };
        let base_of =
            |d: &mut Self, base: PointId| (!d.mechanism.is_fixed(base)).then(|| d.found_image(order, base));
        match unknown {
            Unknown::Turn { link, base, to } => {
                known.extend(base_of(self, base));
                let line = Reference::Points(base, to);
                if second {
                    let normal = self.normal_of(link, to, base);
                    let claim = TermDirection::Claim(Claim::Parallel(line));
                    drawn.extend(self.laid_off(order, normal, claim));
                }
                let quantity = match (second, target) {
                    (false, Target::Pin(pin)) => self.relative_velocity(pin, base),
                    (false, Target::Under(pin, link)) => Quantity::CoincidentVelocity(pin, link),
                    (true, Target::Pin(pin)) => self.tangential_of(pin, base),
                    (true, Target::Under(pin, link)) => Quantity::CoincidentTangential(pin, link),
                };
                drawn.push(sought(quantity, Claim::Perpendicular(line)));
            }
            Unknown::Reach { ram, to } => {
                let Ram { lever, base, slide, .. } = ram;
                known.extend(base_of(self, base));
                let (line, guide) = (Reference::Points(base, to), self.mechanism.slides[slide].guide.link);
                let rider = self.riding_point(slide, to);
                let (parallel, square) =
                    (Claim::Parallel(Reference::Guide(slide)), Claim::Perpendicular(line));
                let mut laid = Vec::new();
                let turning = if second {
                    let normal = TermDirection::Claim(Claim::Parallel(line));
                    drawn.extend(self.laid_off(order, Quantity::CoincidentNormal(to, lever), normal));
                    let to_guide = TermDirection::Claim(Claim::Perpendicular(Reference::Guide(slide)));
                    laid.extend(self.laid_off(order, Quantity::Coriolis(rider, guide), to_guide));
                    laid.extend(self.laid_off(
                        order,
                        Quantity::SlipAcceleration(rider, guide),
                        TermDirection::Claim(parallel),
                    ));
                    Quantity::CoincidentTangential(to, lever)
                } else {
                    laid.extend(self.laid_off(
                        order,
                        Quantity::Slip(rider, guide),
                        TermDirection::Claim(parallel),
                    ));
                    Quantity::CoincidentVelocity(to, lever)
                };
                if ram.slides(self.mechanism) {
                    across = laid
                } else {
                    drawn.append(&mut laid)
                }
                drawn.push(sought(turning, square));
            }
            Unknown::Roll { roll, wheel, centre, back: true } => {
                known.push(self.found_image(order, centre));
                if second {
                    let coriolis = Quantity::Coriolis(centre, self.rolled_on(roll, wheel));
                    drawn.extend(self.laid_off(order, coriolis, TermDirection::Found));
                }
                let claim = self.rolling_direction(roll, wheel, centre).1;
                let (quantity, _) = self.rolling_unknown(order, (roll, wheel, centre), Label::Pole);
                drawn.push(sought(quantity, claim));
                return Side { known, unknown: drawn, back: true, across: Vec::new() };
            }
            Unknown::Roll { roll, wheel, centre, back: false } => {
                let body = self.rolled_on(roll, wheel);
                let claim = match self.other_centre(roll, wheel) {
                    Some(other) => {
                        known.extend(base_of(self, other));
                        let line = Reference::Points(other, centre);
                        if second {
                            let claim = TermDirection::Claim(Claim::Parallel(line));
                            // The same point may have another normal part, about another link's pivot.
                            let normal = if self.mechanism.is_fixed(other) {
                                Quantity::Normal(centre)
                            } else {
                                Quantity::RelativeNormal(centre, other)
                            };
                            drawn.extend(self.laid_off(order, normal, claim));
                        }
                        Claim::Perpendicular(line)
                    }
                    None => {
                        if body != LinkId::FRAME {
                            known.push(self.found_under(order, centre, body));
                        }
                        if second {
                            let coriolis = Quantity::Coriolis(centre, body);
                            drawn.extend(self.laid_off(order, coriolis, TermDirection::Found));
                        }
                        self.rolling_direction(roll, wheel, centre).1
                    }
                };
                let (quantity, _) = self.rolling_unknown(order, (roll, wheel, centre), Label::Pole);
                drawn.push(sought(quantity, claim));
            }
            Unknown::Slide { slide, back } => {
                match self.solved_side(slide, back) {
                    None => known.push(self.found_image(order, pin)),
                    Some(LinkId::FRAME) => {}
                    Some(link) => known.push(self.found_under(order, pin, link)),
                }
                let guide = self.mechanism.slides[slide].guide.link;
                let rider = self.riding_point(slide, pin);
                let line = Reference::Guide(slide);
                if second {
                    let across = TermDirection::Claim(Claim::Perpendicular(line));
                    for part in [Quantity::Coriolis(rider, guide), Quantity::SlipNormal(rider, guide)] {
                        drawn.extend(self.laid_off(order, part, across));
                    }
                }
                let (quantity, reversed) = self.sliding_unknown(order, target, (slide, back));
                drawn.push(sought(quantity, Claim::Parallel(line)));
                return Side { known, unknown: drawn, back: reversed, across: Vec::new() };
            }
            Unknown::Carried { hold, back, link, pin: other } => {
                let side = self.side_of(order, Target::Pin(other), hold.unknown(back, other));
                known.extend(side.known);
                if !side.back {
                    drawn.extend(side.unknown.iter().copied());
                }
                let line = Reference::Points(other, pin);
                let (parallel, square) = (Claim::Parallel(line), Claim::Perpendicular(line));
                let [velocity, normal, tangential] = self.turned_between(link, pin, other);
                let parts = if second {
                    vec![(normal, parallel), (tangential, square)]
                } else {
                    vec![(velocity, square)]
                };
                for (part, claim) in parts {
                    drawn.extend(self.laid_off(order, part, TermDirection::Claim(claim)));
                }
                if side.back {
                    // What slides stands on the other side of the equation, what the link's turning gives on this.
                    known.append(&mut drawn);
                    return Side { known, unknown: side.unknown, back: true, across: Vec::new() };
                }
            }
            Unknown::Contact { roll, body } => {
                let other = self.rolled_on(roll, body);
                if other != LinkId::FRAME {
                    known.push(self.found_under(order, pin, other));
                }
                if second {
                    let claim = self.common_normal(roll).1;
                    drawn.push(sought(Quantity::ContactNormal(pin, other, body), claim));
                }
                return Side { known, unknown: drawn, back: true, across: Vec::new() };
            }
            Unknown::Spin { roll, wheel, centre } => {
                let other = self.rolled_on(roll, wheel);
                let contact = self.contact_of(roll);
                if other != LinkId::FRAME {
                    known.push(self.found_under(order, contact, other));
                }
                let across = Claim::Perpendicular(Reference::Points(centre, contact));
                let part = if second {
                    Quantity::RelativeTangential(centre, contact)
                } else {
                    Quantity::RelativeVelocity(centre, contact)
                };
                drawn.extend(self.laid_off(order, part, TermDirection::Claim(across)));
                if second {
                    // Both lie along one line, and only their sum is sought.
                    let claim = self.common_normal(roll).1;
                    drawn.push(sought(Quantity::ContactNormal(contact, wheel, other), claim));
                    drawn.push(sought(Quantity::RelativeNormal(centre, contact), claim));
                }
            }
        }
        Side { known, unknown: drawn, back: false, across }
    }

    /// A part whose magnitude was calculated and laid off.
    fn laid_off(&self, order: Order, quantity: Quantity, direction: TermDirection) -> Option<Term> {
        let vectors = &self.polygon(order)?.vectors;
        let v = vectors.iter().rev().find(|v| v.quantity == quantity)?;
        let si_per_mm = self.polygon_scale(order).si_per_mm;
        let magnitude = Some(libm::hypot(v.to[0] - v.from[0], v.to[1] - v.from[1]) * si_per_mm);
        Some(Term { quantity, magnitude, direction: Some(direction) })
    }

    /// Images of the further points of the group's links.
    pub(super) fn further_images(&mut self, order: Order, step: &GroupStep, kind: GroupKind) {
        for &(link, point) in &step.points {
            self.board.purpose(match order {
                Order::Acceleration => "acceleration image of a further point",
                _ => "velocity image of a further point",
            });
            let lead = kind.lead(self.mechanism, link);
            if self.mechanism.arc_of_block(link).is_some() {
                // How a block turns on its arc follows from how it slides, which stands by now.
                self.rates_of_blocks(order, &[link]);
            }
            let known = match lead {
                Some(Lead::Turning(base)) => vec![base],
                Some(Lead::Image(base, pin)) => vec![base, pin],
                _ => Vec::new(),
            };
            if let Some(image) = known.iter().find_map(|pin| self.image_as_one(order, link, *pin, point)) {
                let image = self.note_image(order, point, image);
                self.absolute_of(order, point, image);
                continue;
            }
            let image = match lead {
                Some(Lead::Turning(base)) => self.image_about_told(order, link, base, point),
                Some(Lead::Riding(pin)) => self.riding_image(order, link, pin, point),
                Some(Lead::Image(base, pin)) => match self.straight_ratio(link, base, pin, point) {
                    Some(ratio) => self.divide_image(order, (base, pin), point, ratio),
                    None => self.corner_of_image(order, link, (base, pin), point),
                },
                None => continue,
            };
            let image = self.note_image(order, point, image);
            self.absolute_of(order, point, image);
        }
    }

    /// The vector from the pole to a point's image.
    pub(super) fn absolute_of(&mut self, order: Order, point: PointId, image: Point) {
        let label = self.label(point);
        let quantity = match order {
            Order::Acceleration => Quantity::Acceleration(point),
            _ => Quantity::Velocity(point),
        };
        self.absolute_vector(order, quantity, label, image);
    }

    /// The image of a point of a turning link about one whose image is known.
    pub(super) fn image_about(&mut self, order: Order, link: LinkId, base: PointId, point: PointId) -> Point {
        match order {
            Order::Acceleration => self.acceleration_about(link, base, point),
            _ => self.velocity_about(link, base, point),
        }
    }

    /// The same with its equation, where that point moves.
    pub(super) fn image_about_told(
        &mut self,
        order: Order,
        link: LinkId,
        base: PointId,
        point: PointId,
    ) -> Point {
        let begins = self.acts();
        let image = self.image_about(order, link, base, point);
        self.tell_turned(order, link, (base, point), begins);
        image
    }

    /// V_C = V_A + V_CA, of a point of a link whose rotation is known about one that moves, laid off since an act.
    pub(super) fn tell_turned(
        &mut self,
        order: Order,
        link: LinkId,
        (base, point): (PointId, PointId),
        begins: usize,
    ) {
        if self.mechanism.is_fixed(base) || !self.mechanism.link(link).points.contains(&point) {
            return;
        }
        let line = Reference::Points(base, point);
        let (along, across) = (Claim::Parallel(line), Claim::Perpendicular(line));
        let parts = match order {
            Order::Acceleration => vec![
                (Quantity::RelativeNormal(point, base), along),
                (Quantity::RelativeTangential(point, base), across),
            ],
            _ => vec![(Quantity::RelativeVelocity(point, base), across)],
        };
        let first = self.found_image(order, base);
        self.known_sum(order, (point, first), &parts, begins);
    }

    /// A corner of an image, by the lines from two known images, or where they cross too flat by the
    /// similar figure.
    fn corner_of_image(
        &mut self,
        order: Order,
        link: LinkId,
        (base, pin): (PointId, PointId),
        point: PointId,
    ) -> Point {
        if !self.crosses_well(base, pin, point) {
            return self.similar_image(order, link, (base, pin), point);
        }
        let (mut index, begins) = (1, self.acts());
        let turns = [base, pin].map(|base| Unknown::Turn { link, base, to: point });
        let arms = turns.map(|turn| self.route(order, turn, Target::Pin(point), &mut index));
        let equation = self.corner_equation(order, turns, point, begins);
        self.equation(equation);
        let reason = self.reason(&[link]);
        let meet = self.board.meet_lines(arms[0].ray, arms[1].ray, reason);
        self.act(Act::MarkMeet { label: self.label(point), crossing: meet.crossing });
        for (arm, base) in arms.iter().zip([base, pin]) {
            self.note_ray(order, arm.foot.1, meet.at, arm.claim);
            if order == Order::Acceleration {
                let part = (VectorKind::Tangential, self.tangential_of(point, base), Some(arm.claim));
                self.note_vector(order, part, arm.foot, (self.label(point), meet.at));
            }
        }
        meet.at
    }
}

/// How a part of what a link's rotation gives is laid off.
enum Turned {
    /// Along a line.
    Along(Direction),
    /// Component by component.
    By([Mm; 2]),
}

/// The vector from the pole to a point's image, of which nothing is known.
fn sought_whole(order: Order, point: PointId) -> Term {
    let quantity = match order {
        Order::Acceleration => Quantity::Acceleration(point),
        _ => Quantity::Velocity(point),
    };
    Term { quantity, magnitude: None, direction: None }
}
