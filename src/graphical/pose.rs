//! How a solved link stands on the skeleton, and its guides with it.

use crate::board::{Circle, Direction, Line, Point};
use crate::given::Given;
use crate::mechanism::{Form, Guide, GuidePoint, Input, LinkId, Path, PointId, Rider, Slide};

use super::draughtsman::Draughtsman;
use super::missing::Missing;

/// A link's own figure laid on the skeleton: one point of it, and one direction.
pub(super) struct Pose {
    pub(super) own_anchor: Point,
    pub(super) anchor: Point,
    pub(super) own_along: Direction,
    pub(super) along: Direction,
}

impl Clone for Pose {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Pose {}

/// Links that ride on links, and so on; deeper ones are not followed.
pub(super) const DEEPEST: usize = 8;

/// A guide on the skeleton.
pub(super) enum Track {
    Straight(Line),
    Arc(Circle),
}

impl Clone for Track {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Track {}

impl Draughtsman<'_> {
    /// Whether a link's own coordinates are the world's at this instant. In what moves on from this instant no link
    /// but the frame does: there the given places have become its own shape.
    pub(super) fn drawn_in_world(&self, link: LinkId) -> bool {
        link == LinkId::FRAME || matches!(self.mechanism.link(link).form, Form::Placed)
    }

    /// Whether such a link stands on the skeleton as it is drawn: unless its group is being tried.
    pub(super) fn stands_in_world(&self, link: LinkId) -> bool {
        self.drawn_in_world(link) && !self.tried.links.contains(&link)
    }

    /// Notes the pose of a link two of whose points stand on the skeleton.
    pub(super) fn pose_by_points(&mut self, link: LinkId, p: PointId, q: PointId) {
        let (own_anchor, own_other) = (self.own(link, p), self.own(link, q));
        let (anchor, other) = (self.at(p), self.at(q));
        let reason = self.reason(&[link]);
        let (own_along, _) = self.board.toward(own_anchor, own_other, reason);
        let (along, _) = self.board.toward(anchor, other, reason);
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
    }

    /// How a link stands: as a step has noted, or by what stands of it.
    pub(super) fn pose_of(&mut self, link: LinkId) -> Option<Pose> {
        self.pose_by_places(link, DEEPEST)
    }

    /// How a link stands by the places of its points that stand or are given, and by the guide on which it rides;
    /// links on which it rides, and riders on those, are asked as well, so `deep` at most.
    fn pose_by_places(&mut self, link: LinkId, deep: usize) -> Option<Pose> {
        if self.poses[link.0].is_some() || deep == 0 || self.stands_in_world(link) {
            return self.poses[link.0];
        }
        let points = self.mechanism.link(link).points.clone();
        let mut known: Vec<(PointId, Point)> = Vec::new();
        for point in points {
            known.extend(self.places[point.0].or_else(|| self.given_place(point)).map(|at| (point, at)));
        }
        let &(first, anchor) = known.first()?;
        let own_anchor = self.own(link, first);
        if let Some(&(second, at)) = known.get(1) {
            let reason = self.reason(&[link]);
            let own_second = self.own(link, second);
            let (own_along, _) = self.board.toward(own_anchor, own_second, reason);
            let (along, _) = self.board.toward(anchor, at, reason);
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
            return self.poses[link.0];
        }
        let (own_along, along) = self.direction_by_places(link, deep)?;
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        self.poses[link.0]
    }

    /// A direction of a link's own figure and where it points on the skeleton, by its input or by a link against
    /// which it slides without turning.
    fn direction_by_places(&mut self, link: LinkId, deep: usize) -> Option<(Direction, Direction)> {
        if let Some(driven) = self.driven_direction(link) {
            return Some(driven);
        }
        if let Some((slide, pin)) = self.mechanism.arc_of_block(link) {
            // The own x-axis of a block on an arc is the radius, outward.
            let at = self.places[pin.0].or_else(|| self.given_place(pin))?;
            let Track::Arc(circle) = self.track(slide, None) else { return None };
            let reason = self.reason(&[link]);
            let own_along = self.board.rightward();
            let (along, _) = self.board.toward(circle.centre, at, reason);
            return Some((own_along, along));
        }
        let under =
            self.mechanism.slides.iter().position(
                |slide| matches!(slide.rider, Rider::Pin { block: Some(block), .. } if block == link),
            );
        if let Some(slide) = under {
            // The own x-axis of a block on a straight guide lies along it.
            let Track::Straight(guide) = self.track(slide, None) else { return None };
            return Some((self.board.rightward(), guide.along));
        }
        for (ride, other) in self.rides_of(link) {
            if self.stands_in_world(other) || self.pose_by_places(other, deep - 1).is_some() {
                return Some(self.ride_directions(ride, link));
            }
        }
        if self.has_axes_of_world(link) {
            // A wheel, whose turning so far nothing tells.
            let x = self.board.rightward();
            return Some((x, x));
        }
        None
    }

    /// A direction of a driven link's own figure and where it points, where its input states the angle.
    pub(super) fn driven_direction(&mut self, link: LinkId) -> Option<(Direction, Direction)> {
        let (input, angle) =
            self.mechanism.inputs.iter().enumerate().find_map(|(index, input)| match *input {
                Input::Angle { link: driven, angle, .. } | Input::Speed { link: driven, angle, .. }
                    if driven == link =>
                {
                    angle.map(|angle| (index, angle))
                }
                _ => None,
            })?;
        let angle = self.board.input_angle(input, angle);
        let along = self.board.protractor(angle);
        let single = matches!(self.mechanism.link(link).form, Form::Single);
        let own_along = if single { self.board.rightward() } else { self.own_line_of(link) };
        Some((own_along, along))
    }

    /// The slides by which a link slides on another without turning against it, with that other link.
    pub(super) fn rides_of(&self, link: LinkId) -> Vec<(usize, LinkId)> {
        let other = |slide: &Slide| match (slide.rider, slide.guide.link) {
            (Rider::Link { link: rider, turned: Some(_) }, carrier) if rider == link => Some(carrier),
            (Rider::Link { link: rider, turned: Some(_) }, carrier) if carrier == link => Some(rider),
            _ => None,
        };
        let slides = self.mechanism.slides.iter().enumerate();
        slides.filter_map(|(ride, slide)| Some((ride, other(slide)?))).collect()
    }

    /// The place of a point, as far as given places tell it before a step has found it.
    pub(super) fn place_by_places(&mut self, point: PointId) -> Option<Point> {
        if let Some(at) = self.places[point.0].or_else(|| self.given_place(point)) {
            return Some(at);
        }
        let links = self.mechanism.point(point).links.clone();
        let link = links.into_iter().find(|&link| self.pose_of(link).is_some())?;
        let own = self.own(link, point);
        Some(self.carried_point(link, own))
    }

    /// Carries a direction of a link's own figure over to the skeleton, by protractor.
    pub(super) fn carried(&mut self, link: LinkId, own: Direction) -> Direction {
        if self.stands_in_world(link) {
            return own;
        }
        match self.pose_of(link) {
            Some(pose) => {
                let turn = self.board.angle_between(pose.own_along, own);
                self.board.turned(pose.along, turn)
            }
            None => self.no_direction(Missing::Pose(link)),
        }
    }

    /// Carries a point of a link's own figure over to the skeleton, with the set square.
    pub(super) fn carried_point(&mut self, link: LinkId, own: Point) -> Point {
        if self.stands_in_world(link) {
            return own;
        }
        match self.pose_of(link) {
            Some(pose) => {
                let line = Line { through: pose.own_anchor, along: pose.own_along };
                let [forward, left] = self.board.square_off(line, own);
                let foot = self.board.step_off(pose.anchor, pose.along, forward);
                let square = self.board.quarter_turn(pose.along);
                self.board.lay_off(foot, square, left)
            }
            None => self.no_point(Missing::Pose(link)),
        }
    }

    /// A straight guide in the own figure of its link, where only a straight one will do.
    fn own_straight(&mut self, guide: &Guide) -> Line {
        match self.own_line(guide) {
            Track::Straight(line) => line,
            Track::Arc(arc) => {
                let along = self.no_direction(Missing::StraightGuide(guide.link));
                Line { through: arc.centre, along }
            }
        }
    }

    /// A straight guide of a solved link, where only a straight one will do.
    pub(super) fn straight_track(&mut self, slide: usize, of: Option<PointId>) -> Line {
        match self.track(slide, of) {
            Track::Straight(line) => line,
            Track::Arc(arc) => {
                let link = self.mechanism.slides[slide].guide.link;
                let along = self.no_direction(Missing::StraightGuide(link));
                Line { through: arc.centre, along }
            }
        }
    }

    /// A point of a guide in the own figure of its link.
    fn own_guide_point(&mut self, link: LinkId, point: GuidePoint) -> Point {
        match point {
            GuidePoint::Point(p) => self.own(link, p),
            GuidePoint::Own(world) if self.drawn_in_world(link) => self.prick_world(world),
            GuidePoint::Own([x, y]) => {
                let scale = self.length_scale();
                let [x, y] = [x, y].map(|given| {
                    let amount = self.board.amount(given);
                    self.board.to_paper(amount, scale)
                });
                self.board.prick(x, y)
            }
        }
    }

    /// The straight line of a rack or plane, on the skeleton.
    pub(super) fn line_of(&mut self, guide: &Guide) -> Line {
        let own = self.own_straight(guide);
        if self.stands_in_world(guide.link) {
            return own;
        }
        let through = self.carried_point(guide.link, own.through);
        let along = self.carried(guide.link, own.along);
        Line { through, along }
    }

    /// A guide in the own figure of its link. A rider link whose pin stands off the guide moves on a
    /// parallel to it: `of` is the point whose track is wanted.
    pub(super) fn own_track(&mut self, slide: usize, of: Option<PointId>) -> Track {
        let guide = self.mechanism.slides[slide].guide;
        let track = self.own_line(&guide);
        if let (Track::Straight(mut line), Rider::Link { link, turned }, Some(of)) =
            (track, self.mechanism.slides[slide].rider, of)
        {
            line.through = self.beside_guide(slide, line, (link, turned), of);
            return Track::Straight(line);
        }
        track
    }

    pub(super) fn own_line(&mut self, guide: &Guide) -> Track {
        match guide.path {
            Path::Arc { centre, radius } => {
                let centre = self.own_guide_point(guide.link, centre);
                let scale = self.length_scale();
                let radius = self.board.amount(radius);
                Track::Arc(Circle { centre, radius: self.board.to_paper(radius, scale) })
            }
            Path::Straight { through, direction, turned, offset } => {
                let start = self.own_guide_point(guide.link, through);
                let mut along = match direction {
                    crate::mechanism::Direction::Angle(angle) => {
                        let angle = self.board.angle(angle);
                        self.board.protractor(angle)
                    }
                    crate::mechanism::Direction::Toward(p) => {
                        let to = self.own(guide.link, p);
                        let reason = self.reason(&[guide.link]);
                        self.board.toward(start, to, reason).0
                    }
                };
                if turned != Given::exact(0.0) {
                    let by = self.board.angle(turned);
                    along = self.board.turned(along, by);
                }
                let mut line = Line { through: start, along };
                if offset != Given::exact(0.0) {
                    let scale = self.length_scale();
                    let offset = self.board.amount(offset);
                    let mm = self.board.to_paper(offset, scale);
                    let left = self.board.quarter_turn(along);
                    line.through = self.board.lay_off(start, left, mm);
                }
                Track::Straight(line)
            }
        }
    }

    /// The parallel to a guide on which a point of the rider link moves, through the place it has when the
    /// rider's first joint stands at the guide's start.
    fn beside_guide(
        &mut self,
        slide: usize,
        line: Line,
        (rider, turned): (LinkId, Option<Given>),
        of: PointId,
    ) -> Point {
        let Some(&first) = self.mechanism.link(rider).points.first() else {
            return self.no_point(Missing::Joint(rider));
        };
        if first == of {
            return line.through;
        }
        let Some(turned) = turned else {
            // A rider of placed points rides as placed: its points stand where they stand in the world, and so do
            // they in the figure of a guide's link that stands there as well.
            let guide = self.mechanism.slides[slide].guide.link;
            if self.drawn_in_world(guide) {
                return self.own(rider, of);
            }
            // Where the guide's link has a figure of its own, that is looked at on the skeleton.
            let tried = [guide, rider].iter().any(|link| self.tried.links.contains(link));
            let Some(pose) = (if tried { None } else { self.pose_of(guide) }) else {
                return self.no_point(Missing::OwnPoint(guide, of));
            };
            let at = self.own(rider, of);
            let [forward, left] = self.board.square_off(Line { through: pose.anchor, along: pose.along }, at);
            let foot = self.board.step_off(pose.own_anchor, pose.own_along, forward);
            let square = self.board.quarter_turn(pose.own_along);
            return self.board.lay_off(foot, square, left);
        };
        let (from, to) = (self.own(rider, first), self.own(rider, of));
        let own_x = self.board.rightward();
        let [forward, left] = self.board.square_off(Line { through: from, along: own_x }, to);
        let by = self.board.angle(turned);
        let x = self.board.turned(line.along, by);
        let y = self.board.quarter_turn(x);
        let foot = self.board.lay_off(line.through, x, forward);
        self.board.lay_off(foot, y, left)
    }

    /// A guide of a solved link, on the skeleton.
    pub(super) fn track(&mut self, slide: usize, of: Option<PointId>) -> Track {
        let link = self.mechanism.slides[slide].guide.link;
        let own = self.own_track(slide, of);
        if self.stands_in_world(link) {
            return own;
        }
        match own {
            Track::Straight(line) => {
                let through = self.carried_point(link, line.through);
                let along = self.carried(link, line.along);
                Track::Straight(Line { through, along })
            }
            Track::Arc(circle) => {
                let centre = self.carried_point(link, circle.centre);
                Track::Arc(Circle { centre, radius: circle.radius })
            }
        }
    }

    /// A direction of the own figure of a link that slides without turning against a solved one, and where
    /// it points on the skeleton. The link rides on the solved one's guide, or carries the guide on which
    /// that rides. A rider of placed points rides as placed: its own axes are the world's.
    pub(super) fn ride_directions(&mut self, slide: usize, link: LinkId) -> (Direction, Direction) {
        let own_x = self.board.rightward();
        if self.stands_in_world(link) {
            return (own_x, own_x);
        }
        let Slide { rider: Rider::Link { link: rider, turned: Some(turned) }, guide } =
            self.mechanism.slides[slide]
        else {
            // What rides as placed does not say how the other link stands; its own points do, or the rider towards which it
            // swivels.
            let joint = self.mechanism.link(link).points.first().copied();
            let alone = matches!(self.mechanism.link(link).form, Form::Single);
            let pose = match (self.pose_of(link), joint.filter(|p| alone && self.places[p.0].is_some())) {
                (None, Some(joint)) if self.one_joint_link(link, joint).is_ok() => self.poses[link.0],
                (pose, _) => pose,
            };
            return match pose {
                Some(pose) => (pose.own_along, pose.along),
                None => (own_x, self.no_direction(Missing::Pose(link))),
            };
        };
        let by = self.board.angle(turned);
        if rider == link {
            let line = self.straight_track(slide, None);
            return (own_x, self.board.turned(line.along, by));
        }
        let line = self.own_straight(&guide);
        (self.board.turned(line.along, by), self.carried(rider, own_x))
    }

    /// The same where nobody knows yet where the other link stands, only which way: a direction of its own figure, and where
    /// that points on the skeleton.
    pub(super) fn ride_directions_by(
        &mut self,
        slide: usize,
        link: LinkId,
        (own_along, along): (Direction, Direction),
    ) -> Option<(Direction, Direction)> {
        let Slide { rider: Rider::Link { link: rider, turned: Some(turned) }, guide } =
            self.mechanism.slides[slide]
        else {
            return None;
        };
        let by = self.board.angle(turned);
        let own_x = self.board.rightward();
        let of_guide = self.own_straight(&guide).along;
        let carried = if rider == link { of_guide } else { own_x };
        let turn = self.board.angle_between(own_along, carried);
        let carried = self.board.turned(along, turn);
        Some(match rider == link {
            true => (own_x, self.board.turned(carried, by)),
            false => (self.board.turned(of_guide, by), carried),
        })
    }

    /// The track of a point of a link that slides without turning against a solved one, or of a pin on a
    /// guide of a solved link.
    pub(super) fn riding_track(&mut self, slide: usize, link: Option<LinkId>, of: PointId) -> Track {
        let Slide { rider, guide } = self.mechanism.slides[slide];
        let (Some(link), Rider::Link { link: rider, .. }) = (link, rider) else {
            return self.track(slide, Some(of));
        };
        if rider == link {
            return self.track(slide, Some(of));
        }
        // The link carries the guide: its line passes through the first joint of the solved rider.
        let at = match self.mechanism.link(rider).points.first() {
            Some(&first) => {
                let own_first = self.own(rider, first);
                self.carried_point(rider, own_first)
            }
            None => self.no_point(Missing::Joint(rider)),
        };
        let own_of = self.own(link, of);
        let (own_along, along) = self.ride_directions(slide, link);
        self.poses[link.0] = Some(Pose { own_anchor: own_of, anchor: at, own_along, along });
        let own_guide = self.own_straight(&guide);
        let [_, across] = self.board.square_off(own_guide, own_of);
        let along = self.carried(link, own_guide.along);
        let left = self.board.quarter_turn(along);
        Track::Straight(Line { through: self.board.lay_off(at, left, across), along })
    }

    /// The direction of a guide under a point of the skeleton: along a straight guide; on an arc the
    /// radius turned by +90°. With it, on an arc, the direction from the point to the centre.
    pub(super) fn tangent(&mut self, slide: usize, under: PointId) -> (Direction, Option<Direction>) {
        match self.track(slide, Some(under)) {
            Track::Straight(line) => (line.along, None),
            Track::Arc(circle) => {
                let at = self.at(under);
                let link = self.mechanism.slides[slide].guide.link;
                let reason = self.reason(&[link]);
                let (outward, _) = self.board.toward(circle.centre, at, reason);
                let inward = self.board.reverse(outward);
                (self.board.quarter_turn(outward), Some(inward))
            }
        }
    }
}
