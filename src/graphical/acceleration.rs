//! The acceleration polygon, link by link (`s000-ch3a` 2.2 and 2.3).
//!
//! 1. Take a pole o′ for all fixed points.
//! 2. Lay off a′ of a driven point: Aⁿ = V²/l towards the centre, then Aᵗ = ε l perpendicular to the link.
//! 3. From the image of each known point lay off the normal part Aⁿ = V²/l, parallel to the link, from the
//!    pin towards the known point; its end is b′₁ (the first laid off) or b′₂.
//!    On a guide that turns, Coriolis 2 V ω of the sliding velocity, turned by 90° in the sense of ω of the
//!    link that carries the guide; on an arc also V²/R of the sliding towards the centre. Where the lever
//!    is sought, the polygon is closed backwards: Coriolis has its head at the pin's known image.
//! 4. From each foot a line perpendicular to the link (for a slider, from the pole a line parallel to the
//!    guide). They meet in b′.
//! 5. Read the tangential parts; ε = Aᵗ / l, with the sense that the vector shows.
//! 6. Further points as in the velocity polygon.

use crate::board::{Amount, Direction, Line, Mm, Point};
use crate::given::Given;
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::{Drive, Group, GroupKind, Target, Unknown};
use crate::mechanism::{Input, LinkId, Path, PointId, Rider, Roll};
use crate::plan::{GroupStep, Plan};

use super::construction::{Act, Calculation, Claim, Label, Reference, VectorKind};
use super::draughtsman::{Draughtsman, Foot};
use super::dyad::Route;

/// Draws the steps of the acceleration polygon.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) {
    d.open_polygon(Order::Acceleration);
    d.at_contacts.clone_from(&plan.at_contacts);
    let rest = d.rest();
    d.set_rate(Order::Acceleration, LinkId::FRAME, rest);
    d.step(Order::Acceleration, &[], Vec::new());
    d.act(Act::MarkPole);
    for step in plan.steps(Order::Acceleration) {
        d.acceleration_of(step, &d.structure.groups[step.group]);
    }
}

impl Draughtsman<'_> {
    /// Draws the acceleration polygon of one group.
    pub(super) fn acceleration_of(&mut self, step: &GroupStep, group: &Group) {
        match group.kind {
            GroupKind::Driver { base, input } => match input {
                Drive::Input(input) => self.acceleration_of_driver(step, group.links[0], base, input),
                Drive::Trial(_) | Drive::With(_) => {
                    let alpha = self.driven_rate(Order::Acceleration, input);
                    self.set_rate(Order::Acceleration, group.links[0], alpha);
                    self.step(Order::Acceleration, &group.links, Vec::new());
                    self.driven_accelerations(step, group.links[0], base);
                }
            },
            GroupKind::DrivenSlide { slide, input } => self.acceleration_of_slide(step, group, slide, input),
            GroupKind::Wheel { wheel, centre, roll } => self.acceleration_of_wheel(step, wheel, centre, roll),
            GroupKind::Planet { arm, base, wheel, centre, rolls } => {
                self.acceleration_of_planet(step, (arm, base), (wheel, centre), rolls);
                self.further_images(Order::Acceleration, step, group.kind);
            }
            GroupKind::DrivenBar { link, input, .. } | GroupKind::DrivenRack { link, input, .. } => {
                let alpha = self.driven_rate(Order::Acceleration, input);
                self.set_rate(Order::Acceleration, link, alpha);
                self.dyad(Order::Acceleration, step, group);
            }
            GroupKind::DrivenWheel { wheel, centre, roll, guide, input } => {
                let alpha = self.driven_rate(Order::Acceleration, input);
                self.set_rate(Order::Acceleration, wheel, alpha);
                if guide.is_none() && self.rolled_on(roll, wheel) == LinkId::FRAME {
                    self.acceleration_of_rolling_centre(wheel, centre, roll);
                } else {
                    self.dyad(Order::Acceleration, step, group);
                }
                self.points_of_wheel(Order::Acceleration, step, wheel, centre);
            }
            GroupKind::Higher { trial } => self.polygon_by_trial(Order::Acceleration, step, trial),
            _ => self.dyad(Order::Acceleration, step, group),
        }
        self.rates_of_blocks(Order::Acceleration, &group.links);
        for &link in &group.links {
            self.note_link_image(Order::Acceleration, link);
        }
    }

    /// Aⁿ_B or Aⁿ_BA, as the reference moves or not; of the link's own point under a pin of another.
    pub(super) fn normal_of(&self, link: LinkId, point: PointId, base: PointId) -> Quantity {
        if !self.mechanism.link(link).points.contains(&point) {
            Quantity::CoincidentNormal(point, link)
        } else if self.mechanism.is_fixed(base) {
            Quantity::Normal(point)
        } else {
            Quantity::RelativeNormal(point, base)
        }
    }

    /// Aᵗ_B or Aᵗ_BA, as the reference moves or not.
    pub(super) fn tangential_of(&self, point: PointId, base: PointId) -> Quantity {
        if self.mechanism.is_fixed(base) {
            Quantity::Tangential(point)
        } else {
            Quantity::RelativeTangential(point, base)
        }
    }

    /// A_B or A_BA, as the reference moves or not.
    fn relative_acceleration(&self, point: PointId, base: PointId) -> Quantity {
        if self.mechanism.is_fixed(base) {
            Quantity::Acceleration(point)
        } else {
            Quantity::RelativeAcceleration(point, base)
        }
    }

    /// Aⁿ = V² / l as a length on paper, with the calculation recorded.
    fn normal_length(&mut self, link: LinkId, point: PointId, base: PointId) -> (Mm, f64) {
        let scale = self.polygon_scale(Order::Acceleration);
        let length = self.length_to(link, base, point);
        let own = self.mechanism.link(link).points.contains(&point);
        let from = self.image(Order::Velocity, base);
        let to = if own {
            self.image(Order::Velocity, point)
        } else {
            self.image_under(Order::Velocity, point, link)
        };
        let mm = self.board.distance(from, to);
        let velocity_scale = self.polygon_scale(Order::Velocity);
        let speed = self.board.read(mm, velocity_scale);
        let velocity =
            if own { self.relative_velocity(point, base) } else { Quantity::CoincidentVelocity(point, link) };
        let speed = self.speed_as_read(link, velocity, speed);
        let reason = self.reason(&[link]);
        let normal = self.board.square_over(speed, length, reason);
        self.act(Act::Calculate(Calculation::Normal {
            quantity: self.normal_of(link, point, base),
            velocity,
            ends: [base, point],
            speed: speed.value(),
            length: length.value(),
            value: normal.value(),
        }));
        (self.board.to_paper(normal, scale), normal.value())
    }

    /// Lays off the normal part from the image of the base, parallel to the link, from the point towards
    /// the base.
    pub(super) fn lay_off_normal(
        &mut self,
        link: LinkId,
        point: PointId,
        base: PointId,
        label: Label,
    ) -> Point {
        let (mm, value) = self.normal_length(link, point, base);
        let outward = self.outward(link, base, point);
        let inward = self.board.reverse(outward);
        let from = self.image(Order::Acceleration, base);
        let foot = self.lay_off_vector(self.normal_of(link, point, base), from, inward, mm);
        let claim = Claim::Parallel(Reference::Points(base, point));
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Normal, self.normal_of(link, point, base), Some(claim)),
            (self.label(base), from),
            (label, foot),
        );
        self.act(Act::LayOffVector { vector, value, mm: mm.value() });
        if matches!(label, Label::Foot { .. }) {
            self.note_foot(Order::Acceleration, label, foot);
        }
        self.note_part(self.normal_of(link, point, base), from, foot);
        self.feet.push(Foot { link, points: [point, base], tail: from, head: foot });
        foot
    }

    /// Aⁿ towards the base, Aᵗ perpendicular to the link in the sense of ε.
    fn acceleration_of_driver(&mut self, step: &GroupStep, link: LinkId, base: PointId, input: usize) {
        let (Input::Angle { alpha, .. } | Input::Speed { alpha, .. }) = self.mechanism.inputs[input] else {
            return;
        };
        self.board.purpose("acceleration of a driven point");
        self.step(Order::Acceleration, &[link], Vec::new());
        // What the scene states, or leaves out: no number that is computed.
        let uniform = alpha == Given::exact(0.0);
        let alpha = self.board.amount(alpha);
        let alpha = self.rate_as_calculated(Order::Acceleration, link, alpha);
        self.set_rate(Order::Acceleration, link, alpha);
        if !uniform {
            self.driven_accelerations(step, link, base);
            return;
        }
        for &(_, point) in &step.points {
            // Without Aᵗ the end of the normal part is the image itself.
            let (label, begins) = (self.label(point), self.acts());
            let as_one = self.image_as_one(Order::Acceleration, link, base, point);
            let image = as_one.unwrap_or_else(|| self.lay_off_normal(link, point, base, label));
            let image = self.note_image(Order::Acceleration, point, image);
            self.tell_turned(Order::Acceleration, link, (base, point), begins);
            self.whole_acceleration(point, base, image);
        }
    }

    /// Aⁿ and Aᵗ of each wanted point of a link whose ω and ε are known, about its base.
    pub(super) fn driven_accelerations(&mut self, step: &GroupStep, link: LinkId, base: PointId) {
        for &(_, point) in &step.points {
            let image = self.image_about_told(Order::Acceleration, link, base, point);
            let image = self.note_image(Order::Acceleration, point, image);
            self.whole_acceleration(point, base, image);
        }
    }

    /// Coriolis where the guide turns, then the given apparent acceleration along the guide.
    fn acceleration_of_slide(&mut self, step: &GroupStep, group: &Group, slide: usize, input: Drive) {
        let (rider, guide) = (self.mechanism.slides[slide].rider, self.mechanism.slides[slide].guide.link);
        let first = self.riding_point(slide, PointId(0));
        self.board.purpose("acceleration of a driven slide");
        self.step(Order::Acceleration, &group.links, Vec::new());
        let fixed = guide == LinkId::FRAME;
        let (from, along) = self.sliding_foot(slide, false, first, 1);
        let scale = self.polygon_scale(Order::Acceleration);
        let given = self.driven_rate(Order::Acceleration, input);
        let mm = self.board.to_paper(given, scale);
        // What drives a trial may slide on an arc, where this is one of two parts.
        let straight = matches!(self.mechanism.slides[slide].guide.path, Path::Straight { .. });
        let part = if straight {
            Quantity::SlipAcceleration(first, guide)
        } else {
            Quantity::SlipTangential(first, guide)
        };
        let (kind, quantity) = if fixed && straight {
            (VectorKind::Absolute, Quantity::Acceleration(first))
        } else {
            (VectorKind::Sliding, part)
        };
        let image = self.lay_off_vector(quantity, from.1, along, mm);
        self.motion_mut(Order::Acceleration).slidings[slide] = Some(given);
        let image = self.note_image(Order::Acceleration, first, image);
        let claim = Claim::Parallel(Reference::Guide(slide));
        let head = (self.label(first), image);
        let vector = self.note_vector(Order::Acceleration, (kind, quantity, Some(claim)), from, head);
        self.act(Act::LayOffVector { vector, value: given.value().abs(), mm: mm.value().abs() });
        self.note_sliding_parts((first, slide), (from.1, image), false);
        if !fixed {
            let across = Claim::Perpendicular(Reference::Guide(slide));
            let normal = (Quantity::SlipNormal(first, guide), across);
            let parts = [(Quantity::Coriolis(first, guide), across), normal, (part, claim)];
            let under = self.found_under(Order::Acceleration, first, guide);
            self.known_sum(Order::Acceleration, (first, under), &parts, 0);
        }
        if !(fixed && straight) {
            self.absolute_vector(Order::Acceleration, Quantity::Acceleration(first), head.0, image);
        }
        if let Rider::Link { link, .. } = rider {
            let rate = self.rate(Order::Acceleration, guide);
            self.set_rate(Order::Acceleration, link, rate);
            self.riding_points(Order::Acceleration, step, link, first);
        }
    }

    /// The centre of a driven wheel keeps its distance from a body that rests, and nothing slips: Aᵗ = ε r along a line; about
    /// the centre of a circle Aⁿ = V²/l as well.
    fn acceleration_of_rolling_centre(&mut self, wheel: LinkId, centre: PointId, roll: usize) {
        let order = Order::Acceleration;
        self.board.purpose("acceleration image");
        self.step(order, &[wheel], Vec::new());
        let contact = self.contact_of(roll);
        let (start, quantity, kind) = match self.other_centre(roll, wheel) {
            None => {
                let pole =
                    (self.contact_label(roll, LinkId::FRAME), self.contact_image(order, roll, LinkId::FRAME));
                (pole, Quantity::Acceleration(centre), VectorKind::Absolute)
            }
            Some(_) => {
                let route = self.acceleration_roll((roll, wheel, centre), false, 1);
                // What follows on Aⁿ is known too.
                self.take_back_act();
                (route.foot, Quantity::Tangential(centre), VectorKind::Tangential)
            }
        };
        let (at, [part, mm]) = self.lay_off_spin(order, quantity, wheel, [contact, centre], start.1);
        let at = self.note_image(order, centre, at);
        let claim = Claim::Perpendicular(Reference::Points(centre, contact));
        let head = (self.label(centre), at);
        let vector = self.note_vector(order, (kind, quantity, Some(claim)), start, head);
        self.act(Act::LayOffVector { vector, value: part, mm });
        if let Some(other) = self.other_centre(roll, wheel) {
            let line = Claim::Parallel(Reference::Points(other, centre));
            self.parts_of_sum(order, centre, &[(Quantity::Normal(centre), line), (quantity, claim)]);
            self.absolute_of(order, centre, at);
        }
    }

    /// At a rolling contact the tangential parts are equal. All normal parts lie along the common normal and say nothing of
    /// how the wheel turns: its tangential part ends where the line square to the radius meets a parallel to that normal.
    fn acceleration_of_wheel(&mut self, step: &GroupStep, wheel: LinkId, centre: PointId, roll: usize) {
        let contact = self.contact_of(roll);
        if self.at_contacts.contains(&contact) {
            return self.accelerations_at_contact(step, wheel, centre, roll);
        }
        let order = Order::Acceleration;
        self.board.purpose("acceleration of a contact point");
        self.step(order, &[wheel], Vec::new());
        if self.rolls_on_resting_line((roll, wheel), centre) {
            self.turning_on_line((roll, wheel), centre);
            self.points_of_wheel(order, step, wheel, centre);
            return;
        }
        let known = self.contact_without_normals(roll, self.rolled_on(roll, wheel));
        self.act(Act::LeaveOutNormals { contact, centre });
        let from = (self.label(centre), self.image(order, centre));
        let across = Claim::Perpendicular(Reference::Points(centre, contact));
        let along_normal = Claim::Parallel(Reference::Points(centre, contact));
        let square = self.square_to(wheel, centre, contact);
        let normal = self.outward(wheel, centre, contact);
        self.act(Act::DrawRay { from: from.0, claim: across });
        self.act(Act::DrawRay { from: known.0, claim: along_normal });
        let unknown = Unknown::Turn { link: wheel, base: centre, to: contact };
        let ray = Line { through: from.1, along: square };
        let arm = Route { foot: from, ray, claim: across, unknown };
        let reason = self.reason(&[wheel]);
        let meet = self.board.meet_lines(arm.ray, Line { through: known.1, along: normal }, reason);
        let label = self.foot_at_contact(contact, wheel);
        self.note_foot(order, label, meet.at);
        self.act(Act::MarkMeet { label, crossing: meet.crossing });
        self.note_ray(order, from.1, meet.at, across);
        self.note_ray(order, known.1, meet.at, along_normal);
        let target = Target::Under(contact, wheel);
        self.read_alpha(&arm, target, (wheel, centre), (label, meet.at), meet.along[0]);
        self.points_of_wheel(order, step, wheel, centre);
    }

    /// Whether a wheel rolls on a straight line of the frame, and the acceleration of its centre is drawn.
    fn rolls_on_resting_line(&self, (roll, wheel): (usize, LinkId), centre: PointId) -> bool {
        let own = Quantity::Acceleration(centre);
        matches!(self.mechanism.rolls[roll], Roll::Line { wheel: of, .. } if of == wheel)
            && self.rolled_on(roll, wheel) == LinkId::FRAME
            && self.polygon(Order::Acceleration).is_some_and(|p| p.vectors.iter().any(|v| v.quantity == own))
    }

    /// A = ε r of the centre of a wheel on a straight line at rest, from which it keeps its distance.
    fn turning_on_line(&mut self, (roll, wheel): (usize, LinkId), centre: PointId) {
        let order = Order::Acceleration;
        let contact = self.contact_of(roll);
        self.act(Act::RollStraight { wheel, centre });
        // Against the centre the contact point has what the centre has against the contact point, the other way.
        let pole = self.contact_image(order, roll, LinkId::FRAME);
        let (image, square) = (self.image(order, centre), self.square_to(wheel, centre, contact));
        let normal = self.outward(wheel, centre, contact);
        let reason = self.reason(&[wheel]);
        let [ray, across] = [Line { through: image, along: square }, Line { through: pole, along: normal }];
        let along = self.board.meet_lines(ray, across, reason).along[0];
        let quantity = Quantity::Acceleration(centre);
        let scale = self.polygon_scale(order);
        let read = self.board.read(along, scale);
        let tangential = self.as_read(quantity, read);
        let length = self.length_to(wheel, centre, contact);
        let reason = self.reason(&[wheel]);
        let alpha = self.board.quotient(tangential, length, reason);
        let alpha = self.rate_as_calculated(order, wheel, alpha);
        self.set_rate(order, wheel, alpha);
        self.act(Act::Calculate(Calculation::Alpha {
            link: wheel,
            quantity,
            ends: [contact, centre],
            tangential: tangential.value().abs(),
            length: length.value(),
            value: alpha.value(),
        }));
    }

    /// The foot of a link's point at a contact; P of link 3 is written as a point that somebody has called P3, whose own foot is
    /// the first.
    fn foot_at_contact(&self, contact: PointId, link: LinkId) -> Label {
        let written = format!("{}{}", self.mechanism.point(contact).name, self.mechanism.link(link).number);
        let taken = self.mechanism.points.iter().any(|point| point.name == written);
        Label::Foot { point: contact, link: Some(link), index: if taken { 2 } else { 1 } }
    }

    /// Where the acceleration of a solved body's contact point ends but for parts along the common normal: of a body with a
    /// circle Aᵗ = ε r against its centre.
    fn contact_without_normals(&mut self, roll: usize, body: LinkId) -> (Label, Point) {
        let order = Order::Acceleration;
        let contact = self.contact_of(roll);
        let centre = match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => (0..2).find(|&i| links[i] == body).map(|i| centres[i]),
            Roll::Line { wheel, centre, .. } => (wheel == body).then_some(centre),
        };
        let stands = self.image_drawn_under(order, contact, body).is_some();
        let turns = body != LinkId::FRAME && !self.translates[body.0];
        let Some(centre) = centre.filter(|_| turns && !stands) else {
            return (self.contact_label(roll, body), self.contact_image(order, roll, body));
        };
        let start = (self.label(centre), self.image(order, centre));
        let (rate, length) = (self.rate(order, body), self.length_to(body, centre, contact));
        let part = self.board.product(rate, length);
        let quantity = Quantity::CoincidentTangential(contact, body);
        self.act_turning(order, quantity, body, [centre, contact], [rate, length, part]);
        let square = self.square_to(body, centre, contact);
        let scale = self.polygon_scale(order);
        let mm = self.board.to_paper(part, scale);
        let at = self.lay_off_vector(quantity, start.1, square, mm);
        let label = self.foot_at_contact(contact, body);
        let claim = Claim::Perpendicular(Reference::Points(centre, contact));
        let kind = (VectorKind::Tangential, quantity, Some(claim));
        let vector = self.note_vector(order, kind, start, (label, at));
        self.act(Act::LayOffVector { vector, value: part.value().abs(), mm: mm.value().abs() });
        self.note_foot(order, label, at);
        (label, at)
    }

    /// The same where somebody asks for the accelerations of the contact points: with their normal parts the images of both lie
    /// on a parallel to the common normal; the wheel's own lies where that meets the line of its tangential part.
    fn accelerations_at_contact(&mut self, step: &GroupStep, wheel: LinkId, centre: PointId, roll: usize) {
        let contact = self.contact_of(roll);
        self.board.purpose("acceleration of a contact point");
        self.step(Order::Acceleration, &[wheel], Vec::new());
        let other = self.rolled_on(roll, wheel);
        let known = self.contact_image(Order::Acceleration, roll, other);
        let arm = self.acceleration_arm(wheel, centre, contact, 1);
        let normal = self.outward(wheel, centre, contact);
        let label_other = self.label_under(contact, other);
        let along_normal = Claim::Parallel(Reference::Points(centre, contact));
        self.act(Act::DrawRay { from: label_other, claim: along_normal });
        let reason = self.reason(&[wheel]);
        let ray = Line { through: known, along: normal };
        let meet = self.board.meet_lines(arm.ray, ray, reason);
        let at = self.note_under(Order::Acceleration, contact, wheel, meet.at);
        let label = self.label_under(contact, wheel);
        self.act(Act::MarkMeet { label, crossing: meet.crossing });
        self.note_ray(Order::Acceleration, arm.foot.1, at, arm.claim);
        self.note_ray(Order::Acceleration, known, at, along_normal);
        let target = Target::Under(contact, wheel);
        self.read_alpha(&arm, target, (wheel, centre), (label, at), meet.along[0]);
        self.read_contact_normal((roll, wheel), along_normal, (label, at), (label_other, known));
        self.points_of_wheel(Order::Acceleration, step, wheel, centre);
    }

    /// A planet's contact points have the tangential parts of the bodies on which it rolls: through the point that divides the
    /// line between those bodies' images as the centre divides that between the contacts runs a line along the arm. From the
    /// end of Aⁿ of the centre another one square to the arm.
    fn acceleration_of_planet(
        &mut self,
        step: &GroupStep,
        (arm, base): (LinkId, PointId),
        (wheel, centre): (LinkId, PointId),
        rolls: [usize; 2],
    ) {
        let order = Order::Acceleration;
        self.board.purpose("acceleration of a planet's centre");
        self.step(order, &[arm], Vec::new());
        let [first, second] = rolls.map(|roll| {
            let other = self.rolled_on(roll, wheel);
            let image = self.contact_image(order, roll, other);
            (self.label_under(self.contact_of(roll), other), image)
        });
        let turn = self.acceleration_arm(arm, base, centre, 1);
        let ratio = self.ratio_of_contacts((wheel, centre), rolls);
        let between = self.board.divide(first.1, second.1, ratio);
        let label = Label::Foot { point: centre, link: None, index: 2 };
        self.act(Act::DivideImage { label, from: first.0, to: second.0, ratio: ratio.value() });
        self.note_foot(order, label, between);
        let claim = Claim::Parallel(Reference::Points(base, centre));
        self.act(Act::DrawRay { from: label, claim });
        let along = self.outward(arm, base, centre);
        let reason = self.reason(&[arm, wheel]);
        let meet = self.board.meet_lines(turn.ray, Line { through: between, along }, reason);
        let at = self.note_image(order, centre, meet.at);
        let head = (self.label(centre), at);
        self.act(Act::MarkMeet { label: head.0, crossing: meet.crossing });
        self.note_ray(order, turn.foot.1, at, turn.claim);
        self.note_ray(order, between, at, claim);
        self.read_alpha(&turn, Target::Pin(centre), (arm, base), head, meet.along[0]);
        self.absolute_of(order, centre, at);
        self.acceleration_of_wheel(step, wheel, centre, rolls[0]);
    }

    /// Reads the normal acceleration of the solved body's contact point against that of the other body.
    pub(super) fn read_contact_normal(
        &mut self,
        (roll, body): (usize, LinkId),
        claim: Claim,
        tail: (Label, Point),
        head: (Label, Point),
    ) {
        let contact = self.contact_of(roll);
        let relative = Quantity::ContactNormal(contact, self.rolled_on(roll, body), body);
        let part = (VectorKind::Normal, relative, Some(claim));
        let vector = self.note_vector(Order::Acceleration, part, tail, head);
        self.act_read(Order::Acceleration, vector);
    }

    /// The thick vectors to an image: relative to its base, and from the pole.
    pub(super) fn whole_acceleration(&mut self, point: PointId, base: PointId, image: Point) {
        let from = self.image(Order::Acceleration, base);
        let head = (self.label(point), image);
        let kind = self.kind_of(base);
        let quantity = self.relative_acceleration(point, base);
        let tail = (self.label(base), from);
        let vector = self.note_vector(Order::Acceleration, (kind, quantity, None), tail, head);
        self.act_read(Order::Acceleration, vector);
    }

    /// Lays off the normal part, and from its end a line perpendicular to the link.
    pub(super) fn acceleration_arm(&mut self, link: LinkId, base: PointId, pin: PointId, index: u8) -> Route {
        let foot_of = if self.mechanism.link(link).points.contains(&pin) { None } else { Some(link) };
        let label = Label::Foot { point: pin, link: foot_of, index };
        let foot = self.lay_off_normal(link, pin, base, label);
        let along = self.square_to(link, base, pin);
        let claim = Claim::Perpendicular(Reference::Points(base, pin));
        self.act(Act::DrawRay { from: label, claim });
        Route {
            foot: (label, foot),
            ray: Line { through: foot, along },
            claim,
            unknown: Unknown::Turn { link, base, to: pin },
        }
    }

    /// From the end of the known parts of a sliding a line along the guide.
    pub(super) fn acceleration_slide(&mut self, slide: usize, back: bool, pin: PointId, index: u8) -> Route {
        let (foot, along) = self.sliding_foot(slide, back, pin, index);
        let claim = Claim::Parallel(Reference::Guide(slide));
        self.act(Act::DrawRay { from: foot.0, claim });
        let unknown = Unknown::Slide { slide, back };
        Route { foot, ray: Line { through: foot.1, along }, claim, unknown }
    }

    /// Lays off Coriolis and, on an arc, the normal part of the sliding; tells their end and the direction of
    /// the guide. Backwards, they end at the rider's known image.
    pub(super) fn sliding_foot(
        &mut self,
        slide: usize,
        back: bool,
        pin: PointId,
        index: u8,
    ) -> ((Label, Point), Direction) {
        let tangent = self.tangent(slide, pin);
        let start = self.slide_start(Order::Acceleration, (slide, back), pin);
        let link = self.foot_link(slide, back);
        let foot = |index: u8| Label::Foot { point: pin, link, index };
        let end = self.sliding_parts((slide, back), (pin, tangent), start, [foot(index), foot(index + 1)]);
        (end, tangent.0)
    }

    /// The same from a point of the polygon; the feet of both parts bear these labels.
    pub(super) fn sliding_parts(
        &mut self,
        (slide, back): (usize, bool),
        (pin, (along, inward)): (PointId, (Direction, Option<Direction>)),
        (mut label, mut at): (Label, Point),
        feet: [Label; 2],
    ) -> (Label, Point) {
        let guide = self.mechanism.slides[slide].guide;
        let rider = self.riding_point(slide, pin);
        let slip = self.motion(Order::Velocity).slidings[slide];
        let turns = !self.translates[guide.link.0];
        if let (Some(slip), true) = (slip, turns) {
            let coriolis = self.coriolis(slip, (rider, guide.link));
            let left = self.board.quarter_turn(along);
            let kind = (VectorKind::Coriolis, Quantity::Coriolis(rider, guide.link));
            (label, at) = self.lay_off_part(slide, kind, (label, at), (left, coriolis), (back, feet[0]));
        }
        if let (Some(slip), Some(inward), Path::Arc { radius, .. }) = (slip, inward, guide.path) {
            let radius = self.board.amount(radius);
            let reason = self.reason(&[guide.link]);
            let normal = self.board.square_over(slip, radius, reason);
            let quantity = Quantity::SlipNormal(rider, guide.link);
            self.act(Act::Calculate(Calculation::SlipNormal {
                quantity,
                slip: Quantity::Slip(rider, guide.link),
                speed: slip.value().abs(),
                radius: radius.value(),
                value: normal.value(),
            }));
            let kind = (VectorKind::Normal, quantity);
            let end = feet[usize::from(turns)];
            (label, at) = self.lay_off_part(slide, kind, (label, at), (inward, normal), (back, end));
        }
        (label, at)
    }

    /// The known parts of a rolling wheel's centre: Aⁿ = V²/l towards the other centre; on a straight line
    /// that turns, Coriolis. From their end the line of unknown length.
    pub(super) fn acceleration_roll(
        &mut self,
        (roll, wheel, centre): (usize, LinkId, PointId),
        back: bool,
        index: u8,
    ) -> Route {
        let unknown = Unknown::Roll { roll, wheel, centre, back };
        let body = self.rolled_on(roll, wheel);
        let scale = self.polygon_scale(Order::Acceleration);
        if let (Some(other), false) = (self.other_centre(roll, wheel), back) {
            let [from, to] = [self.image(Order::Velocity, other), self.image(Order::Velocity, centre)];
            let mm = self.board.distance(from, to);
            let velocity_scale = self.polygon_scale(Order::Velocity);
            let speed = self.board.read(mm, velocity_scale);
            let length = self.measured(other, centre);
            let reason = self.reason(&[wheel]);
            let normal = self.board.square_over(speed, length, reason);
            let quantity = if self.mechanism.is_fixed(other) {
                Quantity::Normal(centre)
            } else {
                Quantity::RelativeNormal(centre, other)
            };
            self.act(Act::Calculate(Calculation::Normal {
                quantity,
                velocity: self.relative_velocity(centre, other),
                ends: [other, centre],
                speed: speed.value(),
                length: length.value(),
                value: normal.value(),
            }));
            let outward = self.outward(body, other, centre);
            let inward = self.board.reverse(outward);
            let start = self.image(Order::Acceleration, other);
            let mm = self.board.to_paper(normal, scale);
            let foot = self.lay_off_vector(quantity, start, inward, mm);
            let label = Label::Foot { point: centre, link: None, index };
            let vector = self.note_vector(
                Order::Acceleration,
                (VectorKind::Normal, quantity, Some(Claim::Parallel(Reference::Points(other, centre)))),
                (self.label(other), start),
                (label, foot),
            );
            self.act(Act::LayOffVector { vector, value: normal.value(), mm: mm.value() });
            self.note_foot(Order::Acceleration, label, foot);
            let along = self.board.quarter_turn(outward);
            let claim = Claim::Perpendicular(Reference::Points(other, centre));
            self.act(Act::DrawRay { from: label, claim });
            return Route { foot: (label, foot), ray: Line { through: foot, along }, claim, unknown };
        }
        let (along, claim) = self.rolling_direction(roll, wheel, centre);
        // Backwards, Coriolis has its head at the centre's known image.
        let mut from = if back {
            (self.label(centre), self.image(Order::Acceleration, centre))
        } else {
            (self.label_under(centre, body), self.image_under(Order::Acceleration, centre, body))
        };
        if let (Some(speed), false) = (self.rolling_speeds[roll], self.translates[body.0]) {
            let coriolis = self.coriolis(speed, (centre, body));
            let left = self.board.quarter_turn(along);
            let way = if back { self.board.reverse(left) } else { left };
            let mm = self.board.to_paper(coriolis, scale);
            let label = Label::Foot { point: centre, link: Some(body), index };
            let quantity = Quantity::Coriolis(centre, body);
            let foot = self.lay_off_vector(quantity, from.1, way, mm);
            let [tail, head] = if back { [(label, foot), from] } else { [from, (label, foot)] };
            let kind = (VectorKind::Coriolis, quantity, None);
            let vector = self.note_vector(Order::Acceleration, kind, tail, head);
            self.act(Act::LayOffVector { vector, value: coriolis.value().abs(), mm: mm.value().abs() });
            self.note_foot(Order::Acceleration, label, foot);
            self.note_part(quantity, tail.1, head.1);
            from = (label, foot);
        }
        self.act(Act::DrawRay { from: from.0, claim });
        Route { foot: from, ray: Line { through: from.1, along }, claim, unknown }
    }

    /// What the unknown part of a rolling wheel's centre is called.
    pub(super) fn rolling_tangential(&self, roll: usize, wheel: LinkId, centre: PointId) -> Quantity {
        let body = self.rolled_on(roll, wheel);
        match self.other_centre(roll, wheel) {
            Some(other) if self.mechanism.is_fixed(other) => Quantity::Tangential(centre),
            Some(other) => Quantity::RelativeTangential(centre, other),
            None if body == LinkId::FRAME => Quantity::Acceleration(centre),
            None => Quantity::SlipAcceleration(centre, body),
        }
    }

    /// Feet of the sliding parts are named after the rider where the polygon is closed backwards from a
    /// pin, else after the guide's link.
    fn foot_link(&self, slide: usize, back: bool) -> Option<LinkId> {
        let link = self.solved_side(slide, back).map(|_| self.mechanism.slides[slide].guide.link);
        link.filter(|link| *link != LinkId::FRAME)
    }

    /// Aᶜ = 2 V ω, signed along the guide's direction turned by +90°.
    fn coriolis(&mut self, slip: Amount, (rider, link): (PointId, LinkId)) -> Amount {
        let omega = self.rate(Order::Velocity, link);
        let product = self.board.product(omega, slip);
        let coriolis = self.board.sum(product, product);
        self.act(Act::Calculate(Calculation::Coriolis {
            quantity: Quantity::Coriolis(rider, link),
            link,
            slip: Quantity::Slip(rider, link),
            speed: slip.value().abs(),
            omega: omega.value(),
            value: coriolis.value().abs(),
        }));
        coriolis
    }

    /// Lays off a known part from a point, or backwards so that its head is there.
    fn lay_off_part(
        &mut self,
        slide: usize,
        (kind, quantity): (VectorKind, Quantity),
        (label, at): (Label, Point),
        (direction, amount): (Direction, Amount),
        (back, end): (bool, Label),
    ) -> (Label, Point) {
        let scale = self.polygon_scale(Order::Acceleration);
        let mm = self.board.to_paper(amount, scale);
        let way = if back { self.board.reverse(direction) } else { direction };
        let foot = self.lay_off_vector(quantity, at, way, mm);
        let (tail, head) = if back { ((end, foot), (label, at)) } else { ((label, at), (end, foot)) };
        let claim = Claim::Perpendicular(Reference::Guide(slide));
        let vector = self.note_vector(Order::Acceleration, (kind, quantity, Some(claim)), tail, head);
        let (value, mm) = (amount.value().abs(), mm.value().abs());
        self.act(Act::LayOffVector { vector, value, mm });
        self.note_foot(Order::Acceleration, end, foot);
        self.note_part(quantity, tail.1, head.1);
        (end, foot)
    }

    /// Reads the tangential part along a route and divides by the link's length.
    pub(super) fn read_alpha(
        &mut self,
        route: &Route,
        target: Target,
        (link, base): (LinkId, PointId),
        (label, image): (Label, Point),
        along: Mm,
    ) {
        let scale = self.polygon_scale(Order::Acceleration);
        let pin = target.pin();
        let quantity = match target {
            Target::Pin(pin) => self.tangential_of(pin, base),
            Target::Under(pin, link) => Quantity::CoincidentTangential(pin, link),
        };
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Tangential, quantity, Some(route.claim)),
            route.foot,
            (label, image),
        );
        self.act_read(Order::Acceleration, vector);
        self.note_part(quantity, route.foot.1, image);
        let tangential = self.board.read(along, scale);
        let tangential = self.as_read(quantity, tangential);
        let length = self.length_to(link, base, pin);
        let reason = self.reason(&[link]);
        let alpha = self.board.quotient(tangential, length, reason);
        let alpha = self.rate_as_calculated(Order::Acceleration, link, alpha);
        self.set_rate(Order::Acceleration, link, alpha);
        self.act(Act::Calculate(Calculation::Alpha {
            link,
            quantity,
            ends: [base, pin],
            tangential: tangential.value().abs(),
            length: length.value(),
            value: alpha.value(),
        }));
    }

    /// Reads the apparent acceleration along a route.
    pub(super) fn read_sliding(
        &mut self,
        route: &Route,
        target: Target,
        (slide, back): (usize, bool),
        (label, image): (Label, Point),
        along: Mm,
    ) {
        let rider = self.riding_point(slide, target.pin());
        let scale = self.polygon_scale(Order::Acceleration);
        let read = self.board.read(along, scale);
        let value = if back { self.board.opposite(read) } else { read };
        self.motion_mut(Order::Acceleration).slidings[slide] = Some(value);
        let ends = [route.foot, (label, image)];
        let (quantity, reversed) = self.sliding_unknown(Order::Acceleration, target, (slide, back));
        let [tail, head] = if reversed { [ends[1], ends[0]] } else { ends };
        let kind = if route.foot.0 == Label::Pole { VectorKind::Absolute } else { VectorKind::Sliding };
        let vector = self.note_vector(Order::Acceleration, (kind, quantity, Some(route.claim)), tail, head);
        self.act_read(Order::Acceleration, vector);
        self.note_sliding_parts((rider, slide), (ends[0].1, image), back);
    }

    /// Notes the apparent acceleration of a rider, laid off from a foot to an image, or the other way where it was laid off
    /// backwards; on an arc that is its tangential part, and the whole runs over the normal part as well.
    fn note_sliding_parts(
        &mut self,
        (rider, slide): (PointId, usize),
        (foot, image): (Point, Point),
        back: bool,
    ) {
        let guide = self.mechanism.slides[slide].guide;
        let (from, to) = if back { (image, foot) } else { (foot, image) };
        let whole = Quantity::SlipAcceleration(rider, guide.link);
        if let Path::Straight { .. } = guide.path {
            self.note_part(whole, from, to);
            return;
        }
        self.note_part(Quantity::SlipTangential(rider, guide.link), from, to);
        let normal = Quantity::SlipNormal(rider, guide.link);
        if let Some(part) = self.parts.iter().rev().find(|p| p.quantity == normal) {
            let ends = if back { (image, part.head) } else { (part.tail, image) };
            self.note_part(whole, ends.0, ends.1);
        }
    }

    /// Aⁿ = ω² l and Aᵗ = ε l about a point whose image is known.
    pub(super) fn acceleration_about(&mut self, link: LinkId, base: PointId, point: PointId) -> Point {
        self.acceleration_about_from(link, base, point, 1)
    }

    /// The same where the point has a foot already: feet count from `index`.
    pub(super) fn acceleration_about_from(
        &mut self,
        link: LinkId,
        base: PointId,
        point: PointId,
        index: u8,
    ) -> Point {
        if let Some(image) = self.image_as_one(Order::Acceleration, link, base, point) {
            return image;
        }
        if self.may_be_at_joint(link, base, point) {
            return self.acceleration_at_joint(link, base, point, index);
        }
        let scale = self.polygon_scale(Order::Acceleration);
        let foot_of = if self.mechanism.link(link).points.contains(&point) { None } else { Some(link) };
        let label = Label::Foot { point, link: foot_of, index };
        let foot = self.lay_off_normal(link, point, base, label);
        let alpha = self.rate(Order::Acceleration, link);
        let length = self.length_to(link, base, point);
        let tangential = self.board.product(alpha, length);
        let quantity = if self.mechanism.link(link).points.contains(&point) {
            self.tangential_of(point, base)
        } else {
            Quantity::CoincidentTangential(point, link)
        };
        let value = tangential.value().abs();
        self.act_turning(Order::Acceleration, quantity, link, [base, point], [alpha, length, tangential]);
        let square = self.square_to(link, base, point);
        let mm = self.board.to_paper(tangential, scale);
        let image = self.lay_off_vector(quantity, foot, square, mm);
        let claim = Claim::Perpendicular(Reference::Points(base, point));
        let head = if self.mechanism.link(link).points.contains(&point) {
            self.label(point)
        } else {
            self.label_under(point, link)
        };
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Tangential, quantity, Some(claim)),
            (label, foot),
            (head, image),
        );
        self.act(Act::LayOffVector { vector, value, mm: mm.value().abs() });
        self.note_part(quantity, foot, image);
        image
    }

    /// The same of a point that may be where the base is: Aⁿ = ω² l and Aᵗ = ε l along the guide through the base and square to
    /// it, or component by component.
    fn acceleration_at_joint(&mut self, link: LinkId, base: PointId, point: PointId, index: u8) -> Point {
        let order = Order::Acceleration;
        let arm = self.arm_along_guide(link, base, point);
        let length = match arm {
            Some((_, length)) => length,
            None => self.length_to(link, base, point),
        };
        let (omega, alpha) = (self.rate(Order::Velocity, link), self.rate(order, link));
        let (speed, tangential) = (self.board.product(omega, length), self.board.product(alpha, length));
        let normal = self.board.product(omega, speed);
        let (quantity, across) =
            (Quantity::CoincidentNormal(point, link), Quantity::CoincidentTangential(point, link));
        self.act(Act::Calculate(Calculation::Normal {
            quantity,
            velocity: Quantity::CoincidentVelocity(point, link),
            ends: [base, point],
            speed: speed.value().abs(),
            length: length.value().abs(),
            value: normal.value().abs(),
        }));
        let scale = self.polygon_scale(order);
        let from = self.image(order, base);
        let mm = self.board.to_paper(normal, scale);
        let foot = match arm {
            Some((along, _)) => {
                let inward = self.board.reverse(along);
                self.lay_off_vector(quantity, from, inward, mm)
            }
            None => {
                let square = self.board.product(omega, omega);
                let inward = self.way_times(square, [point, base]);
                let inward = inward.map(|part| self.board.to_paper(part, scale));
                self.board.moved(from, inward)
            }
        };
        let label = Label::Foot { point, link: Some(link), index };
        let line = Reference::Points(base, point);
        let kind = (VectorKind::Normal, quantity, Some(Claim::Parallel(line)));
        let vector = self.note_vector(order, kind, (self.label(base), from), (label, foot));
        self.act(Act::LayOffVector { vector, value: normal.value().abs(), mm: mm.value().abs() });
        self.note_foot(order, label, foot);
        self.note_part(quantity, from, foot);
        self.act_turning(order, across, link, [base, point], [alpha, length, tangential]);
        let mm = self.board.to_paper(tangential, scale);
        let image = match arm {
            Some((along, _)) => {
                let square = self.board.quarter_turn(along);
                self.lay_off_vector(across, foot, square, mm)
            }
            None => {
                let by = self.square_parts(alpha, [base, point], order);
                self.board.moved(foot, by)
            }
        };
        let kind = (VectorKind::Tangential, across, Some(Claim::Perpendicular(line)));
        let vector = self.note_vector(order, kind, (label, foot), (self.label_under(point, link), image));
        self.act(Act::LayOffVector { vector, value: tangential.value().abs(), mm: mm.value().abs() });
        self.note_part(across, foot, image);
        image
    }
}
