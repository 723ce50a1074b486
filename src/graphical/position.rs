//! The kinematic skeleton, by protractor, compass and guide (`s000-ch3a` 2.3: choose a length scale; draw;
//! measure any missing length on it).

use crate::board::{Bench, Circle, Direction, Line, Pair, Point, Side};
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::GroupKind;
use crate::mechanism::{Form, Guide, GuidePoint, Input, LinkId, Path, PointId};
use crate::plan::{GroupStep, Plan};

use super::construction::{Act, Claim, ConstructionLine, Reference};
use super::draughtsman::Draughtsman;
use super::{DrawError, Misfit};

/// Draws the steps of the skeleton.
pub(super) fn draw<B: Bench>(d: &mut Draughtsman<'_, B>, plan: &Plan) -> Result<(), DrawError> {
    d.step(Order::Position, &[], Vec::new());
    d.board.purpose("frame");
    for index in 0..d.mechanism.points.len() {
        if d.mechanism.is_fixed(PointId(index)) {
            d.prick_given(PointId(index));
        }
    }
    d.act(Act::MarkPlaces);
    for step in &plan.position {
        let group = &d.structure.groups[step.group];
        let links = group.links.clone();
        d.step(Order::Position, &links, Vec::new());
        match group.kind {
            GroupKind::Driver { base, input } => d.driver(step, links[0], base, input),
            GroupKind::Rrr { links, bases, pin } => d.rrr(step, links, bases, pin)?,
            GroupKind::Rrp { rod, base, pin, slide } => d.rrp(step, rod, base, pin, slide)?,
            GroupKind::Other => {
                return Err(DrawError::NoConstruction { links });
            }
        }
    }
    Ok(())
}

/// Two hints that differ by less than this part cannot choose between two places.
const HINT_TIE: f64 = 1e-9;

impl<B: Bench> Draughtsman<'_, B> {
    /// Where the skeleton's own frame begins: the first fixed point, else the first placed one.
    pub(super) fn origin_of_space(&self) -> [Given; 2] {
        let exact = |fixed: bool| {
            self.mechanism
                .points
                .iter()
                .filter(|p| !fixed || matches!(p.place, crate::mechanism::Place::Fixed(_)))
                .find_map(|p| p.place.exact())
        };
        exact(true).or_else(|| exact(false)).unwrap_or([Given::exact(0.0); 2])
    }

    /// Pricks world coordinates onto the skeleton.
    fn prick_world(&mut self, world: [Given; 2]) -> Point<B> {
        let origin = self.origin_of_space();
        let scale = self.length_scale();
        let coordinate = |d: &mut Self, axis: usize| {
            let (at, from) = (d.board.amount(world[axis]), d.board.amount(origin[axis]));
            let away = d.board.difference(at, from);
            d.board.to_paper(away, scale)
        };
        if world == origin {
            return self.board.origin();
        }
        let x = coordinate(self, 0);
        let y = coordinate(self, 1);
        self.board.prick(x, y)
    }

    /// Pricks a point whose place is given; says whether it was.
    fn prick_given(&mut self, point: PointId) -> bool {
        let Some(world) = self.mechanism.point(point).place.exact() else { return false };
        let at = self.prick_world(world);
        self.place(point, at);
        true
    }

    /// The place of a point that an earlier step found.
    pub(super) fn at(&mut self, point: PointId) -> Point<B> {
        match self.places[point.0] {
            Some(at) => at,
            None => self.board.origin(),
        }
    }

    /// A driven link: lay its points off along the given angle from its base.
    fn driver(&mut self, step: &GroupStep, link: LinkId, base: PointId, input: usize) {
        self.board.purpose("driven link");
        let points = self.mechanism.link(link).points.clone();
        let (Some(&first), Some(&second)) = (points.first(), points.get(1)) else { return };
        let angle = match self.mechanism.inputs[input] {
            Input::Angle { angle, .. } | Input::Speed { angle, .. } => angle,
            Input::Slide { .. } => None,
        };
        let along = match angle {
            Some(angle) => {
                let angle = self.board.angle(angle);
                self.input_angles[link.0] = Some(angle);
                self.board.protractor(angle)
            }
            None => {
                for point in [first, second] {
                    self.prick_given(point);
                }
                let (a, b) = (self.at(first), self.at(second));
                let reason = self.reason(&[link]);
                self.board.toward(a, b, reason).0
            }
        };
        let from = self.at(base);
        for &(_, point) in &step.points {
            if self.prick_given(point) {
                self.act(Act::MarkPlaces);
                continue;
            }
            let at = self.lay_off_driven(link, (first, second), base, point, (from, along));
            self.place(point, at);
            let length = self.length(link, base, point).value();
            let to = at.value();
            let from = from.value();
            let angle = libm::atan2(to[1] - from[1], to[0] - from[0]);
            self.act(Act::LayOffLink { link, from: base, to: point, angle, length });
        }
    }

    /// A point of a driven link whose first-to-second line points `along`.
    fn lay_off_driven(
        &mut self,
        link: LinkId,
        (first, second): (PointId, PointId),
        base: PointId,
        point: PointId,
        (from, along): (Point<B>, Direction<B>),
    ) -> Point<B> {
        let scale = self.length_scale();
        if matches!(self.mechanism.link(link).form, Form::Length(_)) {
            let length = self.length(link, base, point);
            let mm = self.board.to_paper(length, scale);
            let outward = if base == first { along } else { self.board.reverse(along) };
            return self.board.lay_off(from, outward, mm);
        }
        // With the set square along the first-to-second line of the link's own figure.
        let (a, b) = (self.own(link, first), self.own(link, second));
        let reason = self.reason(&[link]);
        let (own_along, _) = self.board.toward(a, b, reason);
        let (start, end) = (self.own(link, base), self.own(link, point));
        let [forward, left] = self.board.square_off(Line { through: start, along: own_along }, end);
        if matches!(self.mechanism.link(link).form, Form::Line(_)) {
            return self.board.lay_off(from, along, forward);
        }
        let foot = self.board.lay_off(from, along, forward);
        let square = self.board.quarter_turn(along);
        self.board.lay_off(foot, square, left)
    }

    /// Two arcs about the known pins (compass).
    fn rrr(
        &mut self,
        step: &GroupStep,
        links: [LinkId; 2],
        bases: [PointId; 2],
        pin: PointId,
    ) -> Result<(), DrawError> {
        self.board.purpose("pin by two arcs");
        let main = [(links[0], bases[0]), (links[1], bases[1])];
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
            self.transfer_points(step, &main, pin);
            return Ok(());
        }
        let circles = [self.circle(main[0], pin), self.circle(main[1], pin)];
        let reason = self.reason(&links);
        let pair = self.board.meet_circles(circles[0], circles[1], reason).map_err(|_| {
            let names = bases.map(|b| self.mechanism.point(b).name.clone());
            let [p, q] = bases.map(|b| self.at(b).value());
            let [r1, r2] = circles.map(|c| c.radius.value() * self.scales.length);
            let [first, second] = names;
            DrawError::CannotAssemble {
                pin,
                why: Box::new(Misfit {
                    first: (first, r1),
                    second: (second, Some(r2)),
                    pin: self.mechanism.point(pin).name.clone(),
                    distance: libm::hypot(p[0] - q[0], p[1] - q[1]) * self.scales.length,
                }),
                range: None,
            }
        })?;
        for ((_, base), circle) in main.iter().zip(circles) {
            let radius = circle.radius.value() * self.scales.length;
            self.act(Act::StrikeArc { centre: *base, to: pin, radius });
        }
        self.take_hinted(&main, pin, pair)?;
        let at = self.at(pin).value();
        let index = self.step_index();
        for circle in circles {
            let (centre, radius) = (circle.centre.value(), circle.radius.value());
            self.space_line(ConstructionLine::Arc { centre, radius, at, step: index });
        }
        self.transfer_points(step, &main, pin);
        Ok(())
    }

    /// An arc about the known pin, and the guide.
    fn rrp(
        &mut self,
        step: &GroupStep,
        rod: LinkId,
        base: PointId,
        pin: PointId,
        slide: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("pin by arc and guide");
        let main = [(rod, base)];
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
            self.transfer_points(step, &main, pin);
            return Ok(());
        }
        let line = self.guide_line(&self.mechanism.slides[slide].guide.clone());
        let circle = self.circle(main[0], pin);
        let reason = self.reason(&[rod]);
        let pair = self.board.meet_line_circle(line, circle, reason).map_err(|_| {
            let [_, distance] = self.board.square_off(line, circle.centre);
            DrawError::CannotAssemble {
                pin,
                why: Box::new(Misfit {
                    first: (
                        self.mechanism.point(base).name.clone(),
                        circle.radius.value() * self.scales.length,
                    ),
                    second: (String::new(), None),
                    pin: self.mechanism.point(pin).name.clone(),
                    distance: distance.value().abs() * self.scales.length,
                }),
                range: None,
            }
        })?;
        self.act(Act::DrawGuide { slide });
        let radius = circle.radius.value() * self.scales.length;
        self.act(Act::StrikeArc { centre: base, to: pin, radius });
        self.take_hinted(&main, pin, pair)?;
        let at = self.at(pin).value();
        let index = self.step_index();
        let (centre, radius) = (circle.centre.value(), circle.radius.value());
        self.space_line(ConstructionLine::Arc { centre, radius, at, step: index });
        self.space_line(ConstructionLine::Ray {
            from: line.through.value(),
            to: at,
            claim: Some(Claim::Parallel(Reference::Guide(slide))),
            step: index,
        });
        self.transfer_points(step, &main, pin);
        Ok(())
    }

    fn circle(&mut self, (link, base): (LinkId, PointId), pin: PointId) -> Circle<B> {
        let length = self.length(link, base, pin);
        let scale = self.length_scale();
        Circle { centre: self.at(base), radius: self.board.to_paper(length, scale) }
    }

    /// A straight guide of the frame, as a line of the skeleton.
    pub(super) fn guide_line(&mut self, guide: &Guide) -> Line<B> {
        let Path::Straight { through, direction, turned, offset } = guide.path else {
            let along = self.board.rightward();
            return Line { through: self.board.origin(), along };
        };
        let start = match through {
            GuidePoint::Point(p) => self.at(p),
            GuidePoint::Own(world) => self.prick_world(world),
        };
        let mut along = match direction {
            crate::mechanism::Direction::Angle(angle) => {
                let angle = self.board.angle(angle);
                self.board.protractor(angle)
            }
            crate::mechanism::Direction::Toward(p) => {
                let to = self.at(p);
                let reason = self.reason(&[LinkId::FRAME]);
                self.board.toward(start, to, reason).0
            }
        };
        if turned != Given::exact(0.0) {
            let by = self.board.angle(turned);
            along = self.board.turned(along, by);
        }
        if offset == Given::exact(0.0) {
            return Line { through: start, along };
        }
        let scale = self.length_scale();
        let offset = self.board.amount(offset);
        let mm = self.board.to_paper(offset, scale);
        let left = self.board.quarter_turn(along);
        Line { through: self.board.lay_off(start, left, mm), along }
    }

    /// Takes the point of a pair that the scene's hints choose.
    fn take_hinted(
        &mut self,
        main: &[(LinkId, PointId)],
        pin: PointId,
        pair: Pair<B>,
    ) -> Result<(), DrawError> {
        let crossing = pair.crossing;
        let side = if pair.tangent { Side::First } else { self.choose(main, pin, pair)? };
        let at = self.board.take(pair, side);
        self.place(pin, at);
        self.act(Act::MarkIntersection { point: pin, crossing });
        Ok(())
    }

    fn choose(&mut self, main: &[(LinkId, PointId)], pin: PointId, pair: Pair<B>) -> Result<Side, DrawError> {
        let origin = self.origin_of_space().map(|g| g.value);
        let per_mm = self.scales.length;
        let miss = |d: &Self, point: PointId, at: [f64; 2]| {
            d.mechanism.point(point).place.hint().map(|hint| {
                let [dx, dy] = [0, 1].map(|k| origin[k] + at[k] * per_mm - hint[k]);
                dx * dx + dy * dy
            })
        };
        let sides = [Side::First, Side::Second];
        let mut score: [Option<f64>; 2] = [None; 2];
        for (side, score) in sides.iter().zip(&mut score) {
            *score = miss(self, pin, self.board.look(&pair, *side));
        }
        // No hint for the pin itself: a hint for another point of its links may still tell.
        if score[0].is_none() {
            let mut hinted: Vec<(LinkId, PointId, PointId)> = Vec::new();
            for &(link, base) in main {
                for &point in &self.mechanism.link(link).points {
                    let known = point == pin || self.places[point.0].is_some();
                    if !known && self.mechanism.point(point).place.hint().is_some() {
                        hinted.push((link, base, point));
                    }
                }
            }
            for (side, score) in sides.iter().zip(&mut score) {
                for &(link, base, point) in &hinted {
                    let at_pin = self.board.take(pair, *side);
                    let at_base = self.at(base);
                    let at = self.corner(link, (base, at_base), (pin, at_pin), point).value();
                    if let Some(m) = miss(self, point, at) {
                        *score = Some(score.unwrap_or(0.0) + m);
                    }
                }
            }
        }
        match score {
            [Some(a), Some(b)] if (a - b).abs() > HINT_TIE * (a + b) => {
                Ok(if a < b { Side::First } else { Side::Second })
            }
            _ => {
                let world = |at: [f64; 2]| [0, 1].map(|k| origin[k] + at[k] * per_mm);
                Err(DrawError::Ambiguous {
                    pin,
                    first: world(self.board.look(&pair, Side::First)),
                    second: world(self.board.look(&pair, Side::Second)),
                })
            }
        }
    }

    /// Transfers the further points of the group that are wanted.
    fn transfer_points(&mut self, step: &GroupStep, main: &[(LinkId, PointId)], pin: PointId) {
        for &(link, point) in &step.points {
            if self.prick_given(point) {
                continue;
            }
            let Some(&(_, base)) = main.iter().find(|(l, _)| *l == link) else { continue };
            let (from, to) = (self.at(base), self.at(pin));
            let at = self.corner(link, (base, from), (pin, to), point);
            self.place(point, at);
            self.act(Act::TransferPoint { link, point });
        }
    }

    /// A point of a link of which two points stand on the skeleton: lay off its own offsets along the base
    /// and square to it.
    fn corner(
        &mut self,
        link: LinkId,
        (p, at_p): (PointId, Point<B>),
        (q, at_q): (PointId, Point<B>),
        point: PointId,
    ) -> Point<B> {
        let reason = self.reason(&[link]);
        let (along, _) = self.board.toward(at_p, at_q, reason);
        let [forward, left] = self.offsets(link, p, q, point);
        let foot = self.board.lay_off(at_p, along, forward);
        if self.is_straight(link) {
            return foot;
        }
        let square = self.board.quarter_turn(along);
        self.board.lay_off(foot, square, left)
    }
}
