//! The velocity polygon, link by link (`s000-ch3a` 2.1 and 2.3).
//!
//! 1. Take a pole o: it represents every point of the fixed plane.
//! 2. Lay off V of a driven point: V = ω l, perpendicular to the link, in the sense of ω.
//! 3. From the image of each known point a line perpendicular to the link (or, for a slider, from the pole
//!    a line parallel to the guide). They meet in the image of the pin.
//! 4. Read V and divide by the length: ω = V / l, with the sense that the vector shows.
//! 5. Further points: divide the image line as the link is divided, or from two images perpendiculars to
//!    the sides; the image has the link's own reading sense.

use crate::board::{Amount, Bench, Line, Point, Ratio};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::GroupKind;
use crate::mechanism::{Input, LinkId, PointId};
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
        let group = &d.structure.groups[step.group];
        match group.kind {
            GroupKind::Driver { base, input } => d.velocity_of_driver(step, group.links[0], base, input),
            GroupKind::Rrr { links, bases, pin } => d.velocity_of_rrr(step, links, bases, pin),
            GroupKind::Rrp { rod, base, pin, slide } => d.velocity_of_rrp(step, rod, base, pin, slide),
            GroupKind::Other => {}
        }
        for &link in &group.links {
            d.note_link_image(Order::Velocity, link);
        }
    }
}

/// One side of a dyad: a link, its pin on a solved link, and the line of its unknown velocity.
pub(super) struct Arm<B: Bench> {
    pub(super) link: LinkId,
    pub(super) base: PointId,
    pub(super) from: (Label, Point<B>),
    pub(super) ray: Line<B>,
    pub(super) claim: Claim,
}

impl<B: Bench> Draughtsman<'_, B> {
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
        let Input::Angle { omega, .. } = self.mechanism.inputs[input] else { return };
        self.board.purpose("velocity of a driven point");
        self.step(Order::Velocity, &[link], Vec::new());
        let omega = self.board.amount(omega);
        self.omegas[link.0] = Some(omega);
        let scale = self.polygon_scale(Order::Velocity);
        for &(_, point) in &step.points {
            let length = self.length(link, base, point);
            let speed = self.board.product(omega, length);
            let quantity = self.relative_velocity(point, base);
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
            let image = self.board.lay_off(from, square, mm);
            self.note_image(Order::Velocity, point, image);
            let claim = Claim::Perpendicular(Reference::Points(base, point));
            let vector = self.note_vector(
                Order::Velocity,
                (self.kind_of(base), quantity, Some(claim)),
                (self.label(base), from),
                (self.label(point), image),
            );
            self.act(Act::LayOffVector { vector, value, mm: mm.value().abs() });
            self.absolute_velocity(point, base, image);
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

    /// From the image of the base a line perpendicular to the link.
    fn velocity_arm(&mut self, link: LinkId, base: PointId, pin: PointId) -> Arm<B> {
        let image = self.image(Order::Velocity, base);
        let along = self.square_to(link, base, pin);
        Arm {
            link,
            base,
            from: (self.label(base), image),
            ray: Line { through: image, along },
            claim: Claim::Perpendicular(Reference::Points(base, pin)),
        }
    }

    /// Two lines of unknown length meet in the image of the pin.
    fn velocity_of_rrr(&mut self, step: &GroupStep, links: [LinkId; 2], bases: [PointId; 2], pin: PointId) {
        self.board.purpose("velocity image of a pin");
        let equation = self.velocity_equation(pin, bases);
        self.step(Order::Velocity, &links, vec![equation]);
        let arms = [self.velocity_arm(links[0], bases[0], pin), self.velocity_arm(links[1], bases[1], pin)];
        for arm in &arms {
            self.act(Act::DrawRay { from: arm.from.0, claim: arm.claim });
        }
        let reason = self.reason(&links);
        let meet = self.board.meet_lines(arms[0].ray, arms[1].ray, reason);
        self.note_image(Order::Velocity, pin, meet.at);
        self.act(Act::MarkMeet { label: self.label(pin), crossing: meet.crossing });
        for (arm, along) in arms.iter().zip(meet.along) {
            self.read_omega(arm, pin, meet.at, along);
        }
        if bases.iter().all(|&base| !self.mechanism.is_fixed(base)) {
            self.absolute_velocity(pin, bases[0], meet.at);
        }
        self.velocity_images(step, &[(links[0], bases[0]), (links[1], bases[1])], pin);
    }

    /// A line perpendicular to the rod, and from the pole a line parallel to the guide.
    fn velocity_of_rrp(&mut self, step: &GroupStep, rod: LinkId, base: PointId, pin: PointId, slide: usize) {
        self.board.purpose("velocity image of a slider");
        let relative = self.relative_velocity(pin, base);
        let along_guide = Claim::Parallel(Reference::Guide(slide));
        let mut right = Vec::new();
        if !self.mechanism.is_fixed(base) {
            right.push(self.found_velocity(base));
        }
        right.push(Term {
            quantity: relative,
            magnitude: None,
            direction: Some(TermDirection::Claim(Claim::Perpendicular(Reference::Points(base, pin)))),
        });
        let left = vec![Term {
            quantity: Quantity::Velocity(pin),
            magnitude: None,
            direction: Some(TermDirection::Claim(along_guide)),
        }];
        self.step(Order::Velocity, &[rod], vec![Equation { left, right }]);
        let arm = self.velocity_arm(rod, base, pin);
        let line = self.guide_line(&self.mechanism.slides[slide].guide.clone());
        let pole = self.board.origin();
        self.act(Act::DrawRay { from: arm.from.0, claim: arm.claim });
        self.act(Act::DrawRay { from: Label::Pole, claim: along_guide });
        let reason = self.reason(&[rod]);
        let guide = Line { through: pole, along: line.along };
        let meet = self.board.meet_lines(arm.ray, guide, reason);
        self.note_image(Order::Velocity, pin, meet.at);
        self.act(Act::MarkMeet { label: self.label(pin), crossing: meet.crossing });
        self.note_ray(Order::Velocity, pole, meet.at, along_guide);
        let vector = self.note_vector(
            Order::Velocity,
            (VectorKind::Absolute, Quantity::Velocity(pin), Some(along_guide)),
            (Label::Pole, pole),
            (self.label(pin), meet.at),
        );
        self.act_read(Order::Velocity, vector);
        self.read_omega(&arm, pin, meet.at, meet.along[0]);
        self.translating_blocks(slide);
        self.velocity_images(step, &[(rod, base)], pin);
    }

    /// A block on a fixed straight guide does not turn.
    fn translating_blocks(&mut self, slide: usize) {
        if let crate::mechanism::Rider::Pin { block: Some(block), .. } = self.mechanism.slides[slide].rider {
            let rest = self.rest();
            self.omegas[block.0] = Some(rest);
            self.alphas[block.0] = Some(rest);
            self.act(Act::Calculate(Calculation::Translation { link: block }));
        }
    }

    /// Reads V along a ray of a dyad and divides by the link's length.
    fn read_omega(&mut self, arm: &Arm<B>, pin: PointId, image: Point<B>, along: crate::board::Mm<B>) {
        let scale = self.polygon_scale(Order::Velocity);
        let quantity = self.relative_velocity(pin, arm.base);
        self.note_ray(Order::Velocity, arm.from.1, image, arm.claim);
        let vector = self.note_vector(
            Order::Velocity,
            (self.kind_of(arm.base), quantity, Some(arm.claim)),
            arm.from,
            (self.label(pin), image),
        );
        self.act_read(Order::Velocity, vector);
        let speed = self.board.read(along, scale);
        let length = self.length(arm.link, arm.base, pin);
        let reason = self.reason(&[arm.link]);
        let omega = self.board.quotient(speed, length, reason);
        self.omegas[arm.link.0] = Some(omega);
        self.act(Act::Calculate(Calculation::Omega {
            link: arm.link,
            quantity,
            ends: [arm.base, pin],
            speed: speed.value().abs(),
            length: length.value(),
            value: omega.value(),
        }));
    }

    /// The vector from the pole to an image that was reached from a moving base.
    fn absolute_velocity(&mut self, point: PointId, base: PointId, image: Point<B>) {
        if self.mechanism.is_fixed(base) {
            return;
        }
        let pole = self.board.origin();
        let vector = self.note_vector(
            Order::Velocity,
            (VectorKind::Absolute, Quantity::Velocity(point), None),
            (Label::Pole, pole),
            (self.label(point), image),
        );
        self.act_read(Order::Velocity, vector);
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

    /// V_B = V_A + V_BA, by both routes where both bases move.
    fn velocity_equation(&mut self, pin: PointId, bases: [PointId; 2]) -> Equation {
        let route = |d: &mut Self, base: PointId| {
            let mut terms = Vec::new();
            if !d.mechanism.is_fixed(base) {
                terms.push(d.found_velocity(base));
            }
            terms.push(Term {
                quantity: d.relative_velocity(pin, base),
                magnitude: None,
                direction: Some(TermDirection::Claim(Claim::Perpendicular(Reference::Points(base, pin)))),
            });
            terms
        };
        // The route from the frame, if there is one, stands on the left.
        let [a, b] = if self.mechanism.is_fixed(bases[1]) { [bases[1], bases[0]] } else { bases };
        Equation { left: route(self, a), right: route(self, b) }
    }

    /// Images of the further points of the group's links.
    fn velocity_images(&mut self, step: &GroupStep, main: &[(LinkId, PointId)], pin: PointId) {
        for &(link, point) in &step.points {
            let Some(&(_, base)) = main.iter().find(|(l, _)| *l == link) else { continue };
            self.board.purpose("velocity image of a further point");
            let image = match self.straight_ratio(link, base, pin, point) {
                Some(ratio) => self.divide_image(Order::Velocity, (base, pin), point, ratio),
                None => self.velocity_corner(link, (base, pin), point),
            };
            self.note_image(Order::Velocity, point, image);
            let pole = self.board.origin();
            let vector = self.note_vector(
                Order::Velocity,
                (VectorKind::Absolute, Quantity::Velocity(point), None),
                (Label::Pole, pole),
                (self.label(point), image),
            );
            self.act_read(Order::Velocity, vector);
        }
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
