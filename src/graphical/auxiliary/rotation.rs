//! The centre of a finite rotation: where the perpendicular bisectors of the ways of two points meet.

use crate::board::{Line, Point};
use crate::mechanism::{LinkId, PointId};

use super::super::centrodes;
use super::super::draughtsman::Draughtsman;
use super::{AuxiliaryAct, PointName, StrokeRole};

impl Draughtsman<'_> {
    /// Draws the second position of the mechanism dashed, with its input at `to`, and the centre about which the
    /// link turns from one to the other.
    pub(super) fn draw_rotation(&mut self, link: LinkId, to: f64) {
        self.board.purpose("centre of a finite rotation");
        let places = match centrodes::places_at(self.mechanism, self.structure, link, to) {
            Ok(places) => places,
            Err(why) => return self.refuse_auxiliary(centrodes::clause(&why)),
        };
        let per_mm = self.scales.length();
        let moved = |d: &mut Self, p: PointId| {
            let at = places.get(p.0).copied().flatten()?;
            Some(d.board.copied(at.map(|x| x / per_mm)))
        };
        for other in self.mechanism.moving().collect::<Vec<_>>() {
            let points = self.mechanism.link(other).points.clone();
            let ends: Vec<Point> = points.iter().filter_map(|&p| moved(self, p)).collect();
            for pair in ends.windows(2) {
                self.aux_line(pair[0], pair[1], StrokeRole::Other, None);
            }
        }
        let points = self.mechanism.link(link).points.clone();
        let known: Vec<PointId> = points.into_iter().filter(|p| self.places[p.0].is_some()).collect();
        let &[a, b, ..] = known.as_slice() else {
            return self.refuse_auxiliary("the link has no two points whose ways could be drawn");
        };
        let (Some(a_moved), Some(b_moved)) = (moved(self, a), moved(self, b)) else {
            return self.refuse_auxiliary("the link has no two points whose ways could be drawn");
        };
        let reason = self.reason(&[link]);
        let ways = [(a, a_moved), (b, b_moved)].map(|(point, after)| {
            let before = self.at(point);
            let (along, _) = self.board.toward(before, after, reason);
            let middle = self.board.middle(before, after);
            let bisector = Line { through: middle, along: self.board.quarter_turn(along) };
            (before, after, bisector)
        });
        let meet = self.board.meet_lines(ways[0].2, ways[1].2, reason);
        let centre = meet.at;
        if !self.stands(centre) {
            return self.refuse_auxiliary("the bisectors are parallel: the link is moved without turning");
        }
        for (before, after, bisector) in ways {
            self.aux_line(before, after, StrokeRole::Construction, None);
            self.aux_line(bisector.through, centre, StrokeRole::Produced, None);
            self.aux_square(bisector.through, before, centre);
        }
        let (from, _) = self.board.toward(centre, ways[0].0, reason);
        let (onto, _) = self.board.toward(centre, ways[0].1, reason);
        let angle = self.board.angle_between(from, onto).value();
        for point in [a, b] {
            if let Some(at) = moved(self, point) {
                self.aux_point(PointName::Moved(point), at);
            }
        }
        self.aux_point(PointName::RotationCentre, centre);
        self.act_auxiliary(AuxiliaryAct::OtherPosition { link, to });
        self.act_auxiliary(AuxiliaryAct::Bisectors { link, points: [a, b], crossing: meet.crossing });
        self.act_auxiliary(AuxiliaryAct::Rotation { link, point: a, angle });
    }
}
