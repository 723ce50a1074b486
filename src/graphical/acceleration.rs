//! The acceleration polygon, link by link (`s000-ch3a` 2.2 and 2.3).
//!
//! 1. Take a pole o′ for all fixed points.
//! 2. Lay off a′ of a driven point: Aⁿ = V²/l towards the centre, then Aᵗ = ε l perpendicular to the link.
//! 3. From the image of each known point lay off the normal part Aⁿ = V²/l, parallel to the link, from the
//!    pin towards the known point; its end is b′₁ (the first laid off) or b′₂.
//! 4. From each foot a line perpendicular to the link (for a slider, from the pole a line parallel to the
//!    guide). They meet in b′.
//! 5. Read the tangential parts; ε = Aᵗ / l, with the sense that the vector shows.
//! 6. Further points as in the velocity polygon.

use crate::board::{Amount, Bench, Line, Mm, Point};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::GroupKind;
use crate::mechanism::{Input, LinkId, PointId};
use crate::plan::{GroupStep, Plan};

use super::construction::{
    Act, Calculation, Claim, Equation, Label, Reference, Term, TermDirection, VectorKind,
};
use super::draughtsman::{Draughtsman, Foot};

/// Draws the steps of the acceleration polygon.
pub(super) fn draw<B: Bench>(d: &mut Draughtsman<'_, B>, plan: &Plan) {
    d.open_polygon(Order::Acceleration);
    d.alphas[LinkId::FRAME.0] = Some(d.rest());
    d.step(Order::Acceleration, &[], Vec::new());
    d.act(Act::MarkPole);
    for step in &plan.acceleration {
        let group = &d.structure.groups[step.group];
        match group.kind {
            GroupKind::Driver { base, input } => d.acceleration_of_driver(step, group.links[0], base, input),
            GroupKind::Rrr { links, bases, pin } => d.acceleration_of_rrr(step, links, bases, pin),
            GroupKind::Rrp { rod, base, pin, slide } => d.acceleration_of_rrp(step, rod, base, pin, slide),
            GroupKind::Other => {}
        }
        for &link in &group.links {
            d.note_link_image(Order::Acceleration, link);
        }
    }
}

/// One side of a dyad after its normal part has been laid off.
struct Arm<B: Bench> {
    link: LinkId,
    base: PointId,
    foot: (Label, Point<B>),
    ray: Line<B>,
    claim: Claim,
}

impl<B: Bench> Draughtsman<'_, B> {
    /// Aⁿ_B or Aⁿ_BA, as the reference moves or not.
    fn normal_of(&self, point: PointId, base: PointId) -> Quantity {
        if self.mechanism.is_fixed(base) {
            Quantity::Normal(point)
        } else {
            Quantity::RelativeNormal(point, base)
        }
    }

    /// Aᵗ_B or Aᵗ_BA, as the reference moves or not.
    fn tangential_of(&self, point: PointId, base: PointId) -> Quantity {
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

    /// V of `point` against `base` of the same link, read off the velocity polygon.
    pub(super) fn read_speed(&mut self, point: PointId, base: PointId) -> Amount<B> {
        let scale = self.polygon_scale(Order::Velocity);
        let (from, to) = (self.image(Order::Velocity, base), self.image(Order::Velocity, point));
        let mm = self.board.distance(from, to);
        self.board.read(mm, scale)
    }

    /// Aⁿ = V² / l as a length on paper, with the calculation recorded.
    fn normal_length(&mut self, link: LinkId, point: PointId, base: PointId) -> (Mm<B>, f64) {
        let scale = self.polygon_scale(Order::Acceleration);
        let length = self.length(link, base, point);
        let speed = self.read_speed(point, base);
        let reason = self.reason(&[link]);
        let normal = self.board.square_over(speed, length, reason);
        self.act(Act::Calculate(Calculation::Normal {
            quantity: self.normal_of(point, base),
            velocity: self.relative_velocity(point, base),
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
    ) -> Point<B> {
        let (mm, value) = self.normal_length(link, point, base);
        let outward = self.outward(link, base, point);
        let inward = self.board.reverse(outward);
        let from = self.image(Order::Acceleration, base);
        let foot = self.board.lay_off(from, inward, mm);
        let claim = Claim::Parallel(Reference::Points(base, point));
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Normal, self.normal_of(point, base), Some(claim)),
            (self.label(base), from),
            (label, foot),
        );
        self.act(Act::LayOffVector { vector, value, mm: mm.value() });
        if matches!(label, Label::Foot { .. }) {
            self.note_foot(Order::Acceleration, label, foot);
        }
        self.feet.push(Foot { link, points: [point, base], tail: from, head: foot });
        foot
    }

    /// Aⁿ towards the base, Aᵗ perpendicular to the link in the sense of ε.
    fn acceleration_of_driver(&mut self, step: &GroupStep, link: LinkId, base: PointId, input: usize) {
        let Input::Angle { alpha, .. } = self.mechanism.inputs[input] else { return };
        self.board.purpose("acceleration of a driven point");
        self.step(Order::Acceleration, &[link], Vec::new());
        let uniform = alpha.value == 0.0;
        let alpha = self.board.amount(alpha);
        self.alphas[link.0] = Some(alpha);
        let scale = self.polygon_scale(Order::Acceleration);
        for &(_, point) in &step.points {
            let label = self.label(point);
            if uniform {
                // Without Aᵗ the end of the normal part is the image itself.
                let image = self.lay_off_normal(link, point, base, label);
                self.note_image(Order::Acceleration, point, image);
                self.whole_acceleration(point, base, image);
                continue;
            }
            let foot_label = Label::Foot { point, link: None, index: 1 };
            let foot = self.lay_off_normal(link, point, base, foot_label);
            let length = self.length(link, base, point);
            let tangential = self.board.product(alpha, length);
            let quantity = self.tangential_of(point, base);
            let value = tangential.value().abs();
            self.act(Act::Calculate(Calculation::Tangential {
                quantity,
                link,
                ends: [base, point],
                alpha: alpha.value(),
                length: length.value(),
                value,
            }));
            let square = self.square_to(link, base, point);
            let mm = self.board.to_paper(tangential, scale);
            let image = self.board.lay_off(foot, square, mm);
            self.note_image(Order::Acceleration, point, image);
            let claim = Claim::Perpendicular(Reference::Points(base, point));
            let vector = self.note_vector(
                Order::Acceleration,
                (VectorKind::Tangential, quantity, Some(claim)),
                (foot_label, foot),
                (label, image),
            );
            self.act(Act::LayOffVector { vector, value, mm: mm.value().abs() });
            self.whole_acceleration(point, base, image);
        }
    }

    /// The thick vectors to an image: relative to its base, and from the pole.
    fn whole_acceleration(&mut self, point: PointId, base: PointId, image: Point<B>) {
        let from = self.image(Order::Acceleration, base);
        let head = (self.label(point), image);
        let kind = self.kind_of(base);
        let quantity = self.relative_acceleration(point, base);
        let tail = (self.label(base), from);
        let vector = self.note_vector(Order::Acceleration, (kind, quantity, None), tail, head);
        self.act_read(Order::Acceleration, vector);
    }

    fn absolute_acceleration(&mut self, point: PointId, image: Point<B>, claim: Option<Claim>) {
        let pole = self.board.origin();
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Absolute, Quantity::Acceleration(point), claim),
            (Label::Pole, pole),
            (self.label(point), image),
        );
        self.act_read(Order::Acceleration, vector);
    }

    /// Lays off the normal part, and from its end a line perpendicular to the link.
    fn acceleration_arm(&mut self, link: LinkId, base: PointId, pin: PointId, index: u8) -> Arm<B> {
        let label = Label::Foot { point: pin, link: None, index };
        let foot = self.lay_off_normal(link, pin, base, label);
        let along = self.square_to(link, base, pin);
        let claim = Claim::Perpendicular(Reference::Points(base, pin));
        self.act(Act::DrawRay { from: label, claim });
        Arm { link, base, foot: (label, foot), ray: Line { through: foot, along }, claim }
    }

    /// Two lines of unknown length from the feet meet in the image of the pin.
    fn acceleration_of_rrr(
        &mut self,
        step: &GroupStep,
        links: [LinkId; 2],
        bases: [PointId; 2],
        pin: PointId,
    ) {
        self.board.purpose("acceleration image of a pin");
        let equation = self.acceleration_equation(pin, [(links[0], bases[0]), (links[1], bases[1])]);
        self.step(Order::Acceleration, &links, vec![equation]);
        // The part from the pole is laid off first, as b′₁.
        let order: [usize; 2] = if self.mechanism.is_fixed(bases[1]) { [1, 0] } else { [0, 1] };
        let arms = [
            self.acceleration_arm(links[order[0]], bases[order[0]], pin, 1),
            self.acceleration_arm(links[order[1]], bases[order[1]], pin, 2),
        ];
        let reason = self.reason(&links);
        let meet = self.board.meet_lines(arms[0].ray, arms[1].ray, reason);
        self.note_image(Order::Acceleration, pin, meet.at);
        self.act(Act::MarkMeet { label: self.label(pin), crossing: meet.crossing });
        for (arm, along) in arms.iter().zip(meet.along) {
            self.read_alpha(arm, pin, meet.at, along);
            self.whole_acceleration(pin, arm.base, meet.at);
        }
        if bases.iter().all(|&base| !self.mechanism.is_fixed(base)) {
            self.absolute_acceleration(pin, meet.at, None);
        }
        self.acceleration_images(step, &[(links[0], bases[0]), (links[1], bases[1])], pin);
    }

    /// From the foot a line perpendicular to the rod, and from the pole a line parallel to the guide.
    fn acceleration_of_rrp(
        &mut self,
        step: &GroupStep,
        rod: LinkId,
        base: PointId,
        pin: PointId,
        slide: usize,
    ) {
        self.board.purpose("acceleration image of a slider");
        let along_guide = Claim::Parallel(Reference::Guide(slide));
        let left = vec![Term {
            quantity: Quantity::Acceleration(pin),
            magnitude: None,
            direction: Some(TermDirection::Claim(along_guide)),
        }];
        let right = self.acceleration_route(pin, rod, base);
        self.step(Order::Acceleration, &[rod], vec![Equation { left, right }]);
        let arm = self.acceleration_arm(rod, base, pin, 1);
        let line = self.guide_line(&self.mechanism.slides[slide].guide.clone());
        let pole = self.board.origin();
        self.act(Act::DrawRay { from: Label::Pole, claim: along_guide });
        let reason = self.reason(&[rod]);
        let guide = Line { through: pole, along: line.along };
        let meet = self.board.meet_lines(arm.ray, guide, reason);
        self.note_image(Order::Acceleration, pin, meet.at);
        self.act(Act::MarkMeet { label: self.label(pin), crossing: meet.crossing });
        self.note_ray(Order::Acceleration, pole, meet.at, along_guide);
        self.absolute_acceleration(pin, meet.at, Some(along_guide));
        self.read_alpha(&arm, pin, meet.at, meet.along[0]);
        if !self.mechanism.is_fixed(base) {
            self.whole_acceleration(pin, base, meet.at);
        }
        self.acceleration_images(step, &[(rod, base)], pin);
    }

    /// Reads the tangential part along a ray and divides by the link's length.
    fn read_alpha(&mut self, arm: &Arm<B>, pin: PointId, image: Point<B>, along: Mm<B>) {
        let scale = self.polygon_scale(Order::Acceleration);
        let quantity = self.tangential_of(pin, arm.base);
        self.note_ray(Order::Acceleration, arm.foot.1, image, arm.claim);
        let vector = self.note_vector(
            Order::Acceleration,
            (VectorKind::Tangential, quantity, Some(arm.claim)),
            arm.foot,
            (self.label(pin), image),
        );
        self.act_read(Order::Acceleration, vector);
        let tangential = self.board.read(along, scale);
        let length = self.length(arm.link, arm.base, pin);
        let reason = self.reason(&[arm.link]);
        let alpha = self.board.quotient(tangential, length, reason);
        self.alphas[arm.link.0] = Some(alpha);
        self.act(Act::Calculate(Calculation::Alpha {
            link: arm.link,
            quantity,
            ends: [arm.base, pin],
            tangential: tangential.value().abs(),
            length: length.value(),
            value: alpha.value(),
        }));
    }

    /// A_A + Aⁿ_BA + Aᵗ_BA.
    fn acceleration_route(&mut self, pin: PointId, link: LinkId, base: PointId) -> Vec<Term> {
        let mut terms = Vec::new();
        if !self.mechanism.is_fixed(base) {
            let image = self.image(Order::Acceleration, base).value();
            terms.push(Term {
                quantity: Quantity::Acceleration(base),
                magnitude: Some(libm::hypot(image[0], image[1]) * self.scales.acceleration),
                direction: Some(TermDirection::Found),
            });
        }
        let line = Reference::Points(base, pin);
        let [p, b] = [self.image(Order::Velocity, base), self.image(Order::Velocity, pin)].map(|x| x.value());
        let speed = libm::hypot(b[0] - p[0], b[1] - p[1]) * self.scales.velocity;
        let length = self.length(link, base, pin).value();
        let normal = speed * speed / length;
        terms.push(Term {
            quantity: self.normal_of(pin, base),
            magnitude: normal.is_finite().then_some(normal),
            direction: Some(TermDirection::Claim(Claim::Parallel(line))),
        });
        terms.push(Term {
            quantity: self.tangential_of(pin, base),
            magnitude: None,
            direction: Some(TermDirection::Claim(Claim::Perpendicular(line))),
        });
        terms
    }

    fn acceleration_equation(&mut self, pin: PointId, arms: [(LinkId, PointId); 2]) -> Equation {
        let [(la, a), (lb, b)] = if self.mechanism.is_fixed(arms[1].1) { [arms[1], arms[0]] } else { arms };
        let left = self.acceleration_route(pin, la, a);
        let right = self.acceleration_route(pin, lb, b);
        Equation { left, right }
    }

    /// Images of the further points of the group's links.
    fn acceleration_images(&mut self, step: &GroupStep, main: &[(LinkId, PointId)], pin: PointId) {
        for &(link, point) in &step.points {
            let Some(&(_, base)) = main.iter().find(|(l, _)| *l == link) else { continue };
            self.board.purpose("acceleration image of a further point");
            let image = match self.straight_ratio(link, base, pin, point) {
                Some(ratio) => self.divide_image(Order::Acceleration, (base, pin), point, ratio),
                None => self.acceleration_corner(link, (base, pin), point),
            };
            self.note_image(Order::Acceleration, point, image);
            self.absolute_acceleration(point, image, None);
        }
    }

    /// A corner of the image triangle, by normal parts and perpendiculars from two images.
    fn acceleration_corner(
        &mut self,
        link: LinkId,
        (base, pin): (PointId, PointId),
        point: PointId,
    ) -> Point<B> {
        if !self.crosses_well(base, pin, point) {
            return self.similar_image(Order::Acceleration, link, (base, pin), point);
        }
        let arms = [self.acceleration_arm(link, base, point, 1), self.acceleration_arm(link, pin, point, 2)];
        let reason = self.reason(&[link]);
        let meet = self.board.meet_lines(arms[0].ray, arms[1].ray, reason);
        self.act(Act::MarkMeet { label: self.label(point), crossing: meet.crossing });
        for arm in &arms {
            self.note_ray(Order::Acceleration, arm.foot.1, meet.at, arm.claim);
            let quantity = self.tangential_of(point, arm.base);
            self.note_vector(
                Order::Acceleration,
                (VectorKind::Tangential, quantity, Some(arm.claim)),
                arm.foot,
                (self.label(point), meet.at),
            );
        }
        meet.at
    }
}
