//! Kennedy's theorem shown on three links of the mechanism (`s000-ch3b` A4): a centre off the line of the two others
//! would have two velocities.

use crate::board::{Direction, Location, Point};
use crate::mechanism::LinkId;
use crate::plan::chord;

use super::super::draughtsman::Draughtsman;
use super::{AuxiliaryAct, PointName, StrokeRole};

/// Length of the velocities at the trial point, mm: their size has no meaning here.
const ARROW: f64 = 16.0;
/// The trial point lies off the line by this part of the distance of two centres, and by no more and no less than
/// these lengths in mm.
const OFF: (f64, f64, f64) = (0.35, 18.0, 40.0);

impl Draughtsman<'_> {
    /// The three centres of the links on one line, and a trial place of the third off it.
    pub(super) fn draw_kennedy(&mut self, links: [LinkId; 3]) {
        self.board.purpose("Kennedy's theorem");
        let [i, j, k] = links;
        let pairs = [chord(i, j), chord(i, k), chord(j, k)];
        let mut places = Vec::new();
        for pair in pairs {
            let Some(&centre) = self.centres.known.get(&pair) else {
                return self.refuse_auxiliary("the circle diagram does not lead to all three centres");
            };
            let reason = self.reason(&pair);
            places.push(self.board.locate(centre, reason));
        }
        let finite: Vec<Point> = places
            .iter()
            .filter_map(|place| match place {
                Location::At(at) => Some(*at),
                Location::Toward(..) => None,
            })
            .collect();
        let Some(&first) = finite.first() else {
            return self.refuse_auxiliary("all three centres are at infinity");
        };
        let reason = self.reason(&links);
        let along = match (finite.get(1), &places[..]) {
            (Some(&second), _) => self.board.toward(first, second, reason).0,
            (None, all) => {
                let far = all.iter().find_map(|place| match place {
                    Location::Toward(direction, _) => Some(*direction),
                    Location::At(_) => None,
                });
                match far {
                    Some(direction) => direction,
                    None => return self.refuse_auxiliary("the three centres fall together"),
                }
            }
        };
        let page = self.per_page;
        let gap = finite.get(1).map_or(OFF.2 * page, |second| {
            let (p, q) = (first.value(), second.value());
            libm::hypot(q[0] - p[0], q[1] - p[1])
        });
        if gap < page {
            return self.refuse_auxiliary("two of the centres fall together: every line goes through them");
        }
        // Off the line, beside its middle: anywhere else would do as well.
        let middle = finite.get(1).map_or(first, |&second| self.board.middle(first, second));
        let mut across = self.board.quarter_turn(along);
        // On the side where fewer links stand in the way.
        let [ax, ay] = across.value();
        let [mx, my] = middle.value();
        let lean: f64 =
            self.places.iter().flatten().map(|p| p.value()).map(|[x, y]| (x - mx) * ax + (y - my) * ay).sum();
        if lean > 0.0 {
            across = self.board.reverse(across);
        }
        let off = self.board.millimetres((OFF.0 * gap).clamp(OFF.1 * page, OFF.2 * page));
        let trial = self.board.lay_off(middle, across, off);

        for &at in &finite[1..] {
            self.aux_line(first, at, StrokeRole::Axis, None);
        }
        if finite.len() == 1 {
            let reach = self.board.millimetres(OFF.2 * page);
            let end = self.board.lay_off(first, along, reach);
            self.aux_line(first, end, StrokeRole::Axis, None);
        }
        for (pair, place) in pairs.iter().zip(&places) {
            if let Location::At(at) = place {
                self.aux_point(PointName::Centre(*pair), *at);
            }
        }
        self.aux_point(PointName::Trial, trial);
        for (link, place) in [(j, &places[0]), (k, &places[1])] {
            let radius = match place {
                Location::At(at) => {
                    self.aux_line(trial, *at, StrokeRole::Construction, None);
                    self.board.toward(*at, trial, reason).0
                }
                Location::Toward(direction, _) => {
                    let end = self.board.lay_off(trial, *direction, off);
                    self.aux_line(trial, end, StrokeRole::Construction, None);
                    *direction
                }
            };
            self.trial_velocity(link, trial, radius, place);
        }
        self.act_auxiliary(AuxiliaryAct::TrialCentre { links });
        self.act_auxiliary(AuxiliaryAct::TrialVelocities { links });
        self.act_auxiliary(AuxiliaryAct::OneLine { links });
    }

    /// The velocity of the trial point as a point of a link: square to the radius.
    fn trial_velocity(&mut self, link: LinkId, trial: Point, radius: Direction, place: &Location) {
        let square = self.board.quarter_turn(radius);
        let length = self.board.millimetres(ARROW * self.per_page);
        let tip = self.board.lay_off(trial, square, length);
        self.aux_line(trial, tip, StrokeRole::Vector, None);
        if let Location::At(at) = place {
            self.aux_square(trial, *at, tip);
        }
        self.aux_point(PointName::TrialVelocity(link), tip);
    }
}
