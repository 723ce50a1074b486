//! Points of a group that stands by given places: each where two of its loci meet, circles about points of its own links
//! and guides of links that stand.

use crate::board::{Circle, Direction, Line, Point};
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::TrialDriver;
use crate::mechanism::{Form, Input, LinkId, PointId, Rider, Roll, Slide};
use crate::plan::GroupStep;

use super::DrawError;
use super::construction::Act;
use super::draughtsman::Draughtsman;
use super::pose::{DEEPEST, Pose, Track};
use super::position::TOUCHES;

/// Whether two loci are parallel lines or circles about one centre, as far as is seen.
fn lie_on_each_other(first: Track, second: Track) -> bool {
    match (first, second) {
        (Track::Straight(one), Track::Straight(other)) => {
            let ([a, b], [c, d]) = (one.along.value(), other.along.value());
            (a * d - b * c).abs() < TOUCHES
        }
        (Track::Arc(one), Track::Arc(other)) => {
            let ([a, b], [c, d]) = (one.centre.value(), other.centre.value());
            libm::hypot(a - c, b - d) < TOUCHES * one.radius.value()
        }
        _ => false,
    }
}

impl Draughtsman<'_> {
    /// Finds places from the given ones, link by link, whatever is driven: of a link that two points tell, or one and a
    /// direction, or one and a guide that passes a rider; and of points at the meet of two loci. They count as given
    /// from then on. Says whether there were any.
    pub(super) fn lead_by_places(&mut self) -> bool {
        let links: Vec<LinkId> = self.mechanism.moving().filter(|&l| !self.mechanism.link(l).block).collect();
        let points: Vec<PointId> = (0..self.mechanism.points.len()).map(PointId).collect();
        for &point in &points {
            self.prick_given(point);
        }
        self.step(Order::Position, &[], Vec::new());
        let mut led = false;
        // What only touches tells a pose by its last digits, if at all: it waits until nothing else tells any.
        let mut told_only = true;
        loop {
            let mut further = false;
            for &link in &links {
                if self.stands_in_world(link) || self.poses[link.0].is_some() {
                    continue;
                }
                let stands = self.stands_alone(link)
                    || self.pose_of(link).is_some()
                    || self.stands_by_rides(link)
                    || self.stands_by_guide(link);
                if self.nothing_missing().is_err() || !stands || told_only && !self.pose_is_told(link) {
                    self.poses[link.0] = None;
                    continue;
                }
                further = true;
                told_only = true;
                for point in self.mechanism.link(link).points.clone() {
                    if self.places[point.0].is_none() {
                        let own = self.own(link, point);
                        let at = self.carried_point(link, own);
                        self.place(point, at);
                        self.act(Act::TransferPoint { link, point });
                    }
                }
            }
            further |= matches!(self.place_by_loci(&points), Ok(true)) && self.nothing_missing().is_ok();
            if !further {
                if !std::mem::replace(&mut told_only, false) {
                    break;
                }
                continue;
            }
            led = true;
        }
        self.pricked.clone_from(&self.places);
        led
    }

    /// Lays on a link of which one point stands, where links that slide on each other without turning lead its direction
    /// over from one that stands.
    fn stands_by_rides(&mut self, link: LinkId) -> bool {
        let points = self.mechanism.link(link).points.clone();
        let Some(base) = points.into_iter().find(|p| self.places[p.0].is_some()) else { return false };
        let Some((own_along, along)) = self.direction_by_rides(link, None, DEEPEST) else { return false };
        let (own_anchor, anchor) = (self.own(link, base), self.at(base));
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        true
    }

    /// A direction of a link's own figure and where it points, by the angle of its input, or by rides on links that stand or
    /// whose own direction is found so; `come_by` is the ride by which it is asked for.
    pub(super) fn direction_by_rides(
        &mut self,
        link: LinkId,
        come_by: Option<usize>,
        deep: usize,
    ) -> Option<(Direction, Direction)> {
        if deep == 0 {
            return None;
        }
        // Where the group is being tried, the angle is what may be left open.
        if !self.tried.links.contains(&link)
            && let Some(driven) = self.driven_direction(link)
        {
            return Some(driven);
        }
        for (ride, other) in self.rides_of(link) {
            if come_by == Some(ride) {
                continue;
            }
            if self.stands_in_world(other) || self.pose_of(other).is_some() {
                return Some(self.ride_directions(ride, link));
            }
            let found =
                self.tried_direction(other).or_else(|| self.direction_by_rides(other, Some(ride), deep - 1));
            if let Some(found) = found {
                return self.ride_directions_by(ride, link, found);
            }
        }
        None
    }

    /// A direction of the own figure of a link that is turned by trial, and where it points as it is tried.
    fn tried_direction(&mut self, link: LinkId) -> Option<(Direction, Direction)> {
        let angle = self.tried_place(TrialDriver::Turn(link))?;
        Some((self.own_line_of(link), self.board.protractor(angle)))
    }

    /// Lays on a link of which one point stands, where its guide passes a rider that stands, or a riding link of which any
    /// point does.
    fn stands_by_guide(&mut self, link: LinkId) -> bool {
        let stands = |d: &Self, point: PointId| d.places[point.0].is_some();
        let points = self.mechanism.link(link).points.clone();
        let Some(base) = points.into_iter().find(|&p| stands(self, p)) else { return false };
        let single = matches!(self.mechanism.link(link).form, Form::Single);
        let rider = (0..self.mechanism.slides.len()).find_map(|slide| {
            let pair = self.mechanism.slides[slide];
            // A link of one joint swivels by its guide, or not at all.
            if pair.guide.link != link || single && !self.swivels_on(link, slide) {
                return None;
            }
            let further = match pair.rider {
                Rider::Link { link: rod, turned: Some(_) } => self.mechanism.link(rod).points.as_slice(),
                _ => &[],
            };
            let mut riders = self.joint_of_rider(slide).into_iter().chain(further.iter().copied());
            riders.find(|&rider| rider != base && stands(self, rider)).map(|rider| (slide, rider))
        });
        let Some((slide, rider)) = rider else { return false };
        let nothing = GroupStep { group: 0, points: Vec::new() };
        self.rpr(&nothing, link, base, rider, slide).is_ok()
    }

    /// Whether a link's pose, as it stands, is told by what it was found from: a guide that only touches an arc does not tell how
    /// its link is turned.
    fn pose_is_told(&mut self, link: LinkId) -> bool {
        let Some(pose) = self.poses[link.0] else { return true };
        self.board.tape().aside(true);
        let scale = self.length_scale();
        let one = self.board.amount(Given::exact(scale.si_per_mm));
        let ahead = self.board.to_paper(one, scale);
        let end = self.board.lay_off(pose.anchor, pose.along, ahead);
        let start = self.board.lay_off(pose.own_anchor, pose.own_along, ahead);
        self.board.tape().aside(false);
        [start, end].into_iter().all(|at| self.is_told(at))
    }

    /// Finds the place of one more of these points; says whether there was one.
    ///
    /// # Errors
    /// Where two loci of a point do not meet, or nothing says in which of two places.
    pub(super) fn place_by_loci(&mut self, points: &[PointId]) -> Result<bool, DrawError> {
        for &point in points {
            if self.places[point.0].is_some() || self.given_place(point).is_some() {
                continue;
            }
            if let Some(at) = self.driven_along(point) {
                self.place(point, at);
                return Ok(true);
            }
            let (circles, main) = self.circles_of(point);
            let mut loci: Vec<Track> = self.guides_of(point);
            loci.extend(circles.into_iter().map(Track::Arc));
            loci.extend(self.contacts_of(point));
            loci.extend(self.circles_about_driven(point).into_iter().map(Track::Arc));
            loci.extend(self.tracks_beside_guides(point));
            loci.extend(self.tracks_by_carried_guides(point));
            let Some((&first, others)) = loci.split_first() else { continue };
            // Two that lie on each other meet everywhere: one that crosses them tells the place.
            let crosses = |other: &&Track| !lie_on_each_other(first, **other);
            let Some(&second) = others.iter().find(crosses).or(others.first()) else { continue };
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
            // Where they only touch, a stated place tells where on them the point is.
            if let Some(stated) = self.stated_hints[point.0]
                && self.is_unclear(&met)
            {
                let at = self.brought_to(first, stated);
                self.place(point, at);
                return Ok(true);
            }
            let pair = met.map_err(|_| DrawError::NoClosure { pin: point, least: f64::INFINITY })?;
            self.take_hinted(&main, None, point, pair)?;
            return Ok(true);
        }
        Ok(false)
    }

    /// The place of a rider on a guide that stands, where an input says how far along it that is.
    fn driven_along(&mut self, point: PointId) -> Option<Point> {
        for (input, driven) in self.mechanism.inputs.iter().enumerate() {
            let &Input::Slide { slide, at: Some(way), .. } = driven else { continue };
            let guide = self.mechanism.slides[slide].guide.link;
            let stands = self.stands_in_world(guide) || self.pose_of(guide).is_some();
            if self.joint_of_rider(slide) != Some(point) || !stands {
                continue;
            }
            let Track::Straight(line) = self.track(slide, None) else { continue };
            let way = self.board.input_amount(input, way);
            let scale = self.length_scale();
            let along = self.board.to_paper(way, scale);
            return Some(self.board.lay_off(line.through, line.along, along));
        }
        None
    }

    /// The parallels to its link's guides on which a point lies, where it is known how that link is turned and a rider of the
    /// guide stands.
    fn tracks_by_carried_guides(&mut self, point: PointId) -> Vec<Track> {
        let mut tracks = Vec::new();
        for slide in 0..self.mechanism.slides.len() {
            let guide = self.mechanism.slides[slide].guide;
            let link = guide.link;
            let of_link = link != LinkId::FRAME && self.mechanism.link(link).points.contains(&point);
            let rider = self.joint_of_rider(slide).and_then(|rider| self.places[rider.0]);
            let (Some(at), true) = (rider, of_link) else { continue };
            let Track::Straight(own) = self.own_line(&guide) else { continue };
            let Some((own_along, along)) = self.direction_by_rides(link, None, DEEPEST) else { continue };
            let turn = self.board.angle_between(own_along, own.along);
            let along = self.board.turned(along, turn);
            let own_point = self.own(link, point);
            let [_, across] = self.board.square_off(own, own_point);
            let left = self.board.quarter_turn(along);
            tracks.push(Track::Straight(Line { through: self.board.lay_off(at, left, across), along }));
        }
        tracks
    }

    /// A circle about a rider that stands on a guide of a point's own link, where an input says how far along the guide
    /// it is: in the link's own figure it is a point like any other.
    fn circles_about_driven(&mut self, point: PointId) -> Vec<Circle> {
        let mut circles = Vec::new();
        for (input, driven) in self.mechanism.inputs.iter().enumerate() {
            let &Input::Slide { slide, at: Some(way), .. } = driven else { continue };
            let Slide { rider: Rider::Pin { point: pin, .. }, guide } = self.mechanism.slides[slide] else {
                continue;
            };
            let carried = self.mechanism.link(guide.link).points.contains(&point);
            let Some(centre) = self.places[pin.0].filter(|_| carried && pin != point) else { continue };
            let Track::Straight(line) = self.own_track(slide, None) else { continue };
            let way = self.board.input_amount(input, way);
            let scale = self.length_scale();
            let along = self.board.to_paper(way, scale);
            let own_pin = self.board.lay_off(line.through, line.along, along);
            let own = self.own(guide.link, point);
            circles.push(Circle { centre, radius: self.board.distance(own_pin, own) });
        }
        circles
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

    /// Where rolling bodies that stand hold the centre of a wheel; on which side of a line its hint tells.
    fn contacts_of(&mut self, point: PointId) -> Vec<Track> {
        let mut tracks = Vec::new();
        for roll in 0..self.mechanism.rolls.len() {
            let (wheel, other, body) = match self.mechanism.rolls[roll] {
                Roll::Circles { links: [a, _], centres: [p, q], .. } if p == point => (a, Some(q), None),
                Roll::Circles { links: [_, b], centres: [p, q], .. } if q == point => (b, Some(p), None),
                Roll::Line { guide, wheel, centre, .. } if centre == point => (wheel, None, Some(guide.link)),
                _ => continue,
            };
            // Where a link holds the distance, its own circle is that of the contact.
            let held = other.is_some_and(|other| {
                let links = &self.mechanism.point(point).links;
                links.iter().any(|link| self.mechanism.point(other).links.contains(link))
            });
            let stands = match (other, body) {
                (Some(other), _) => self.places[other.0].is_some(),
                (_, Some(body)) => self.stands_in_world(body) || self.pose_of(body).is_some(),
                _ => false,
            };
            if held || !stands {
                continue;
            }
            let all = self.centre_tracks(roll, wheel);
            let hint = self.hint_on_paper(point);
            let miss = |track: &Track| match (track, hint) {
                (Track::Straight(line), Some(hint)) => {
                    let ([x, y], [cos, sin]) = (line.through.value(), line.along.value());
                    ((hint[1] - y) * cos - (hint[0] - x) * sin).abs()
                }
                _ => 0.0,
            };
            if let (Some(track), true) = (
                all.iter().copied().min_by(|a, b| miss(a).total_cmp(&miss(b))),
                all.len() == 1 || hint.is_some(),
            ) {
                tracks.push(track);
            }
        }
        tracks
    }

    /// The parallels to guides of links that stand on which a further point of a link moves that rides there without turning.
    fn tracks_beside_guides(&mut self, point: PointId) -> Vec<Track> {
        let mut tracks = Vec::new();
        for slide in 0..self.mechanism.slides.len() {
            let Slide { rider: Rider::Link { link, turned: Some(_) }, guide } = self.mechanism.slides[slide]
            else {
                continue;
            };
            let further = self.joint_of_rider(slide) != Some(point)
                && self.mechanism.point(point).links.contains(&link);
            if further && (self.stands_in_world(guide.link) || self.pose_of(guide.link).is_some()) {
                tracks.push(self.track(slide, Some(point)));
            }
        }
        tracks
    }

    /// The guides on which a point rides, itself or as the first joint of a link, of links that stand.
    fn guides_of(&mut self, point: PointId) -> Vec<Track> {
        let mut tracks = Vec::new();
        for slide in 0..self.mechanism.slides.len() {
            let pair = self.mechanism.slides[slide];
            let rides = self.joint_of_rider(slide) == Some(point);
            let guide = pair.guide.link;
            if rides && (self.stands_in_world(guide) || self.pose_of(guide).is_some()) {
                tracks.push(self.track(slide, Some(point)));
            }
        }
        tracks
    }
}
