//! Points of a group that stands by given places: each where two of its loci meet, circles about points of its own links
//! and guides of links that stand.

use crate::board::Circle;
use crate::mechanism::{LinkId, PointId, Rider};

use super::DrawError;
use super::draughtsman::Draughtsman;
use super::pose::Track;

impl Draughtsman<'_> {
    /// Finds the place of one more of these points; says whether there was one.
    ///
    /// # Errors
    /// Where two loci of a point do not meet, or nothing says in which of two places.
    pub(super) fn place_by_loci(&mut self, points: &[PointId]) -> Result<bool, DrawError> {
        for &point in points {
            if self.places[point.0].is_some() || self.given_place(point).is_some() {
                continue;
            }
            let (circles, main) = self.circles_of(point);
            let mut loci: Vec<Track> = self.guides_of(point);
            loci.extend(circles.into_iter().map(Track::Arc));
            let &[first, second, ..] = loci.as_slice() else { continue };
            let links = self.mechanism.point(point).links.clone();
            let reason = self.reason(&links);
            let met = match (first, second) {
                (Track::Straight(one), Track::Straight(other)) => {
                    let meet = self.board.meet_lines(one, other, reason);
                    self.place(point, meet.at);
                    return Ok(true);
                }
                (Track::Straight(line), Track::Arc(arc)) | (Track::Arc(arc), Track::Straight(line)) => {
                    self.board.meet_line_circle(line, arc, reason)
                }
                (Track::Arc(one), Track::Arc(other)) => self.board.meet_circles(one, other, reason),
            };
            let pair = met.map_err(|_| DrawError::NoClosure { pin: point, least: f64::INFINITY })?;
            self.take_hinted(&main, None, point, pair)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// Circles about points of a point's own links that stand, and the links with these points.
    fn circles_of(&mut self, point: PointId) -> (Vec<Circle>, Vec<(LinkId, PointId)>) {
        let mut main = Vec::new();
        for link in self.mechanism.point(point).links.clone() {
            let others = self.mechanism.link(link).points.clone();
            let base = others
                .into_iter()
                .find(|&p| p != point && (self.places[p.0].is_some() || self.prick_given(p)));
            main.extend(base.map(|base| (link, base)));
        }
        (main.iter().map(|&with| self.circle(with, point)).collect(), main)
    }

    /// The guides on which a point rides, of links that stand.
    fn guides_of(&mut self, point: PointId) -> Vec<Track> {
        let mut tracks = Vec::new();
        for slide in 0..self.mechanism.slides.len() {
            let pair = self.mechanism.slides[slide];
            let rides = matches!(pair.rider, Rider::Pin { point: pin, .. } if pin == point);
            let guide = pair.guide.link;
            if rides && (self.stands_in_world(guide) || self.pose_of(guide).is_some()) {
                tracks.push(self.track(slide, Some(point)));
            }
        }
        tracks
    }
}
