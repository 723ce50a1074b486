//! Racks that are pinned to a solved link and held against a wheel whose centre stands already. In the rack's own
//! figure the wheel's centre lies on a parallel to its line, one radius away on either side; an arc about the pin,
//! with the distance of the centre, meets that parallel, and the figure is laid on.

use crate::board::{Circle, Line, Side};
use crate::mechanism::structure::Drive;
use crate::mechanism::{Form, LinkId, PointId, Roll};
use crate::plan::GroupStep;

use super::construction::Act;
use super::draughtsman::Draughtsman;
use super::missing::Missing;
use super::pose::{Pose, Track};
use super::position::chooses;
use super::{DrawError, Misfit};

/// A line that is nearer to a pin than this part of the pin's distance from the wheel runs through it.
const THROUGH_THE_PIN: f64 = 1e-9;

impl Draughtsman<'_> {
    /// The pose of a pinned rack, with its wanted points and the contact.
    pub(super) fn pinned_rack(
        &mut self,
        step: &GroupStep,
        (link, base): (LinkId, PointId),
        (wheel, centre): (LinkId, PointId),
        roll: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("rack on a pin and a wheel");
        let mut placed = self.mechanism.link(link).points.iter().copied();
        let placed = placed.find(|&p| p != base && self.is_given(p));
        if matches!(self.mechanism.link(link).form, Form::Placed) {
            let (anchor, x) = (self.at(base), self.board.rightward());
            self.poses[link.0] = Some(Pose { own_anchor: anchor, anchor, own_along: x, along: x });
        } else if let Some(point) = placed {
            self.prick_given(point);
            self.pose_by_points(link, base, point);
        } else {
            self.poses[link.0] = Some(self.pose_against((link, base), centre, roll)?);
        }
        self.transfer_by_pose(step, link);
        self.contact(wheel, roll);
        Ok(())
    }

    /// The pose of a driven rack, with its wanted points and the contact: from a given place of it as its input says that it
    /// stands, or towards another one; or as it touches the wheel. Rolling says nothing of where it began.
    pub(super) fn driven_rack(
        &mut self,
        step: &GroupStep,
        (link, input): (LinkId, Drive),
        (wheel, centre): (LinkId, PointId),
        roll: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("driven rack");
        let points = self.mechanism.link(link).points.clone();
        let placed: Vec<PointId> = points.iter().copied().filter(|&p| self.prick_given(p)).collect();
        let Some(&base) = placed.first() else {
            return Err(match points.first() {
                Some(&point) => DrawError::NotPlaced { point },
                None => DrawError::Missing(Missing::Joint(link)),
            });
        };
        self.act(Act::MarkPlaces);
        if matches!(self.mechanism.link(link).form, Form::Single) {
            self.one_joint_link(link, base)?;
        } else if placed.len() > 1 || self.stands_in_world(link) || self.driven_angle(input).is_some() {
            let (own_along, along) = self.bar_direction(link, input)?;
            let (own_anchor, anchor) = (self.own(link, base), self.at(base));
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        } else {
            self.poses[link.0] = Some(self.pose_against((link, base), centre, roll)?);
        }
        self.transfer_by_pose(step, link);
        self.contact(wheel, roll);
        Ok(())
    }

    /// The pose in which a rack through its pin touches the wheel, of up to four the one that the hints choose.
    fn pose_against(
        &mut self,
        (link, base): (LinkId, PointId),
        centre: PointId,
        roll: usize,
    ) -> Result<Pose, DrawError> {
        let reason = self.reason(&[link]);
        let (anchor, at_centre) = (self.at(base), self.at(centre));
        let (along, distance) = self.board.toward(anchor, at_centre, reason);
        let own_anchor = self.own(link, base);
        let circle = Circle { centre: own_anchor, radius: distance };
        let mut poses = Vec::new();
        let own_line = self.own_rack_line(roll);
        for track in own_line.map_or(Vec::new(), |line| self.own_centre_tracks(line, roll)) {
            let Ok(pair) = self.board.meet_line_circle(track, circle, reason) else { continue };
            let sides = if pair.tangent { &[Side::First][..] } else { &[Side::First, Side::Second] };
            for &side in sides {
                let own_centre = self.board.take(pair, side);
                let (own_along, _) = self.board.toward(own_anchor, own_centre, reason);
                poses.push(Pose { own_anchor, anchor, own_along, along });
            }
        }
        let tried: Vec<_> = poses.iter().map(|&pose| self.hints_of_pose(link, pose)).collect();
        let score = |index: usize| tried[index].0.unwrap_or(f64::INFINITY);
        let Some(best) = (0..poses.len()).min_by(|&a, &b| score(a).total_cmp(&score(b))) else {
            return Err(self.too_near(base, centre, distance.value()));
        };
        let per_mm = self.scales.length();
        let rival = (0..poses.len()).find(|&other| {
            other != best
                && match (tried[best].0, tried[other].0) {
                    (Some(a), Some(b)) => !chooses(a, b, per_mm),
                    _ => true,
                }
        });
        if let Some(rival) = rival {
            // Without a second point no hint can say how the rack stands.
            return Err(match (tried[best].1, tried[rival].1) {
                (Some((pin, first)), Some((_, second))) => DrawError::Ambiguous { pin, first, second },
                _ => DrawError::Missing(Missing::Pose(link)),
            });
        }
        self.chosen(best);
        if let (Roll::Line { radius, .. }, Some(line)) = (&self.mechanism.rolls[roll], own_line) {
            let (pin, through, along) = (own_anchor.value(), line.through.value(), line.along.value());
            let offset = ((pin[0] - through[0]) * along[1] - (pin[1] - through[1]) * along[0]).abs();
            // What is left of a line through the pin itself is no distance from it.
            let offset = if offset > THROUGH_THE_PIN * distance.value() { offset * per_mm } else { 0.0 };
            self.act(Act::DrawTouching { link, base, centre, offset, radius: radius.value });
        }
        Ok(poses[best])
    }

    /// A rack's line in its own figure; none of an arc.
    fn own_rack_line(&mut self, roll: usize) -> Option<Line> {
        let Roll::Line { guide, .. } = self.mechanism.rolls[roll] else { return None };
        match self.own_line(&guide) {
            Track::Straight(line) => Some(line),
            Track::Arc(_) => None,
        }
    }

    /// In a rack's own figure the parallels to its line on which the wheel's centre can lie.
    fn own_centre_tracks(&mut self, line: Line, roll: usize) -> Vec<Line> {
        let Roll::Line { radius, .. } = self.mechanism.rolls[roll] else { return Vec::new() };
        let scale = self.length_scale();
        let radius = self.board.amount(radius);
        let mm = self.board.to_paper(radius, scale);
        let left = self.board.quarter_turn(line.along);
        let right = self.board.reverse(left);
        [left, right].map(|way| Line { through: self.board.lay_off(line.through, way, mm), ..line }).to_vec()
    }

    /// The wheel is too near to the pin for the rack to pass between.
    fn too_near(&self, base: PointId, centre: PointId, distance: f64) -> DrawError {
        let name = |point: PointId| self.mechanism.point(point).name.clone();
        let distance = distance * self.scales.length();
        DrawError::CannotAssemble {
            pin: centre,
            why: Box::new(Misfit {
                first: (name(base), distance),
                second: (String::new(), None),
                pin: name(centre),
                distance,
            }),
            range: None,
        }
    }
}
