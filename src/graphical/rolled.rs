//! How far wheels have rolled. A drawing of one instant does not need it: a wheel's points are placed. Where a
//! mechanism moves on from that instant, they are carried along by the angle that the wheel has turned since: on a
//! line the way of its centre over its radius, on a circle by the ratio of the radii, both seen from what carries
//! the line or the line of centres.

use crate::board::{Angle, Direction};
use crate::mechanism::{Form, GivenPoint, LinkId, PointId, Roll};
use crate::plan::GroupStep;

use super::construction::Act;
use super::draughtsman::Draughtsman;
use super::missing::Missing;
use super::pose::Pose;

/// Where points stood when the wheels began to roll, metres in the world, by point; empty in a drawing of one
/// instant.
pub(crate) type Starts = [Option<GivenPoint>];

impl Draughtsman<'_> {
    /// Lays the figure of a wheel onto the skeleton as far turned as it has rolled, and its wanted points with it.
    pub(super) fn roll_on(&mut self, step: &GroupStep, wheel: LinkId, centre: PointId, roll: usize) {
        let Some(by) = self.rolled_through(wheel, centre, roll) else {
            self.miss_of(Missing::Pose(wheel));
            return;
        };
        self.turned_by[wheel.0] = Some(by);
        let (own_anchor, anchor) = (self.own(wheel, centre), self.at(centre));
        let (own_along, along) = if matches!(self.mechanism.link(wheel).form, Form::Single) {
            // Its own axes were the world's.
            (self.board.rightward(), self.board.protractor(by))
        } else {
            let start = |p: PointId| self.starts.get(p.0).copied().flatten();
            let points = &self.mechanism.link(wheel).points;
            let marked = points.iter().copied().find(|&p| p != centre && start(p).is_some());
            let Some((point, from, to)) = marked.and_then(|p| Some((p, start(centre)?, start(p)?))) else {
                self.miss_of(Missing::Pose(wheel));
                return;
            };
            let reason = self.reason(&[wheel]);
            let own_point = self.own(wheel, point);
            let (own_along, _) = self.board.toward(own_anchor, own_point, reason);
            let (from, to) = (self.prick_world(from), self.prick_world(to));
            let (began, _) = self.board.toward(from, to, reason);
            (own_along, self.board.turned(began, by))
        };
        self.poses[wheel.0] = Some(Pose { own_anchor, anchor, own_along, along });
        for &(link, point) in &step.points {
            if link != wheel || point == centre {
                continue;
            }
            let own = self.own(link, point);
            let at = self.carried_point(link, own);
            self.place(point, at);
            self.act(Act::TransferPoint { link, point });
        }
    }

    /// The angle that a wheel has turned through.
    fn rolled_through(&mut self, wheel: LinkId, centre: PointId, roll: usize) -> Option<Angle> {
        let scale = self.length_scale();
        let reason = self.reason(&[wheel]);
        match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, radii, internal } => {
                let own = usize::from(links[1] == wheel);
                let other = 1 - own;
                let [from, to] = [other, own].map(|i| self.at(centres[i]));
                let (along, _) = self.board.toward(from, to, reason);
                let carried = self.since_start(along);
                let driving = self.link_turned(links[other])?;
                let [driver, driven] = [other, own].map(|i| {
                    let radius = self.board.amount(radii[i]);
                    self.board.to_paper(radius, scale)
                });
                // Seen from the line of centres the two turn inversely as their radii.
                let seen = self.board.angle_less(driving, carried);
                let ratio = self.board.ratio(driver, driven, reason);
                let rolled = self.board.part_of_angle(seen, ratio);
                Some(if internal {
                    self.board.angle_sum(carried, rolled)
                } else {
                    self.board.angle_less(carried, rolled)
                })
            }
            Roll::Line { guide, radius, .. } => {
                let line = self.line_of(&guide);
                let at = self.at(centre);
                let [along, across] = self.board.square_off(line, at);
                let start = self.board.as_it_stands(along);
                let way = self.board.less(along, start);
                let radius = self.board.amount(radius);
                let radius = self.board.to_paper(radius, scale);
                let rolled = self.board.arc_angle(way, radius, reason);
                let carried = self.link_turned(guide.link)?;
                // On the left of its line a wheel that runs forward turns clockwise.
                Some(if across.value() > 0.0 {
                    self.board.angle_less(carried, rolled)
                } else {
                    self.board.angle_sum(carried, rolled)
                })
            }
        }
    }

    /// How far a solved link has turned.
    fn link_turned(&mut self, link: LinkId) -> Option<Angle> {
        if link == LinkId::FRAME {
            return Some(self.board.angle(crate::given::Given::exact(0.0)));
        }
        if let Some(turned) = self.turned_by[link.0] {
            return Some(turned);
        }
        if self.poses[link.0].is_none() {
            let points = self.mechanism.link(link).points.iter().copied();
            let known: Vec<PointId> = points.filter(|p| self.places[p.0].is_some()).collect();
            let &[p, q, ..] = known.as_slice() else { return None };
            self.pose_by_points(link, p, q);
        }
        self.poses[link.0]?;
        // Its own x-axis: the line by which it was laid on may lead to a point that moves along it.
        let own_x = self.board.rightward();
        let along = self.carried(link, own_x);
        Some(self.since_start(along))
    }

    /// How far a direction has turned since it stood as it stands in this drawing.
    fn since_start(&mut self, along: Direction) -> Angle {
        let began = self.board.as_it_points(along);
        self.board.turned_since(began, along)
    }
}
