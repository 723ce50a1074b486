//! The inflection circle and the acceleration centre of a link, after Euler and Savary.
//!
//! 1. The pole P: where the path normals of two points meet.
//! 2. On the pole ray of a point A with the centre of curvature A₀ the inflection point J lies at
//!    AJ = AP² / AA₀, from A toward A₀ (Euler–Savary). Where the path is straight, J is the point itself. Where A₀ is not
//!    known, AJ = Aⁿ / ω² toward P from the acceleration polygon.
//! 3. The lines square to two pole rays at their J meet in the inflection pole W (Thales): the circle on PW holds every
//!    point whose path has an inflection here, and whose acceleration therefore has no normal part.
//! 4. The acceleration centre G sees PW under a right angle, turned from it by φ with tan φ = ε / ω².

use crate::board::{Direction, Line, Location, Point};
use crate::mechanism::quantity::Order;
use crate::mechanism::{LinkId, PointId, Rider};
use crate::plan::chord;

use super::super::construction::{Claim, Reference};
use super::super::draughtsman::Draughtsman;
use super::super::pose::Track;
use super::{AuxiliaryAct, InflectionBy, PointName, StrokeRole};

/// What guides the path of a point of the link.
#[derive(Clone, Copy)]
enum PathOf {
    /// It turns about a fixed pivot.
    Pivot(PointId),
    /// It runs on a guide of the frame, by index of the sliding pair.
    Guide(usize),
    /// Its velocity and its acceleration are known, and nothing else.
    Free,
}

/// A point of the link with the normal of its path.
struct Station {
    point: PointId,
    path: PathOf,
    at: Point,
    normal: Direction,
}

impl Clone for Station {
    fn clone(&self) -> Self {
        *self
    }
}

impl Copy for Station {}

impl Draughtsman<'_> {
    /// Draws both for a link whose accelerations stand.
    pub(super) fn draw_inflection(&mut self, link: LinkId) {
        self.board.purpose("inflection circle");
        let omega = self.rate(Order::Velocity, link);
        if omega.value() == 0.0 {
            self.refuse_auxiliary("the link does not turn here: it has no inflection circle");
            return;
        }
        let Some(stations) = self.stations(link) else {
            self.refuse_auxiliary("the link has no two points whose path normals differ");
            return;
        };
        let lines = stations.map(|s| self.board.extended(Line { through: s.at, along: s.normal }));
        let reason = self.reason(&[link]);
        let pole = self.board.cross_lines(lines[0], lines[1]).map(|p| self.board.locate(p, reason));
        let pole = match pole {
            Some(Location::At(pole)) if self.stands(pole) => pole,
            Some(Location::Toward(..)) => {
                self.refuse_auxiliary("the pole is at infinity: there is no inflection circle");
                return;
            }
            _ => {
                self.refuse_auxiliary("the path normals coincide here: the pole is not determined");
                return;
            }
        };
        let points = stations.map(|s| s.point);
        let [n, m] = stations.map(|s| s.normal.value());
        let crossing = libm::asin((n[0] * m[1] - n[1] * m[0]).abs().min(1.0));
        self.aux_point(PointName::Centre(chord(LinkId::FRAME, link)), pole);
        for station in stations {
            let claim = match station.path {
                PathOf::Pivot(pivot) => Some(Claim::Parallel(Reference::Points(pivot, station.point))),
                PathOf::Guide(slide) => Some(Claim::Perpendicular(Reference::Guide(slide))),
                PathOf::Free => None,
            };
            self.aux_line(station.at, pole, StrokeRole::Produced, claim);
        }
        self.act_auxiliary(AuxiliaryAct::PoleByNormals { link, points, crossing });

        let squares = stations.map(|station| self.inflection_point(link, station, pole));
        let meet = self.board.meet_lines(squares[0], squares[1], reason);
        let summit = meet.at;
        if !self.stands(summit) {
            self.refuse_auxiliary("the inflection circle is not determined here");
            return;
        }
        for square in squares {
            self.aux_line(square.through, summit, StrokeRole::Produced, None);
            self.aux_square(square.through, pole, summit);
        }
        let centre = self.board.middle(pole, summit);
        let diameter = self.board.distance(pole, summit);
        self.aux_circle(centre, diameter.value() / 2.0, StrokeRole::Result);
        self.aux_point(PointName::InflectionPole, summit);
        let scale = self.length_scale();
        let real = self.board.read(diameter, scale);
        self.act_auxiliary(AuxiliaryAct::InflectionCircle {
            link,
            points,
            mm: diameter.value(),
            diameter: real.value(),
        });
        self.acceleration_centre(link, pole, summit);
    }

    /// Two points of the link with known path normals that differ; those whose curvature is known first.
    fn stations(&mut self, link: LinkId) -> Option<[Station; 2]> {
        let points = self.mechanism.link(link).points.clone();
        let mut all: Vec<Station> = points.iter().filter_map(|&p| self.guided(link, p)).collect();
        let free: Vec<Station> = points.iter().filter_map(|&p| self.free(link, p)).collect();
        all.extend(free);
        let first = *all.first()?;
        // Flatter than 3° is badly readable by hand, and 0 is no crossing.
        let sine = |s: &Station| {
            let (u, v) = (first.normal.value(), s.normal.value());
            (u[0] * v[1] - u[1] * v[0]).abs()
        };
        let second = all[1..].iter().find(|s| s.point != first.point && sine(s) > 0.05);
        let second = second.or_else(|| {
            let others = all[1..].iter().filter(|s| s.point != first.point);
            others.max_by(|a, b| sine(a).total_cmp(&sine(b)))
        })?;
        Some([first, *second])
    }

    /// A point whose path is a circle about a pivot, or a guide of the frame.
    fn guided(&mut self, link: LinkId, point: PointId) -> Option<Station> {
        let at = self.places[point.0]?;
        let reason = self.reason(&[link]);
        let others = self.mechanism.point(point).links.clone();
        let pivot = others.into_iter().filter(|&l| l != link && l != LinkId::FRAME).find_map(|l| {
            let pivots = self.mechanism.link(l).points.iter().copied();
            pivots.into_iter().find(|&p| self.mechanism.is_fixed(p))
        });
        if let Some(pivot) = pivot.filter(|p| self.places[p.0].is_some()) {
            let from = self.at(pivot);
            let (normal, _) = self.board.toward(at, from, reason);
            return Some(Station { point, path: PathOf::Pivot(pivot), at, normal });
        }
        let slide = self.mechanism.slides.iter().position(|s| {
            s.guide.link == LinkId::FRAME && matches!(s.rider, Rider::Pin { point: p, .. } if p == point)
        })?;
        let (along, _) = self.tangent(slide, point);
        let normal = self.board.quarter_turn(along);
        Some(Station { point, path: PathOf::Guide(slide), at, normal })
    }

    /// A point with a velocity: its path normal is square to it.
    fn free(&mut self, link: LinkId, point: PointId) -> Option<Station> {
        let at = self.places[point.0]?;
        let image = self.motion(Order::Velocity).images[point.0]?;
        self.motion(Order::Acceleration).images[point.0]?;
        let pole = self.board.origin();
        let reason = self.reason(&[link]);
        let (along, speed) = self.board.toward(pole, image, reason);
        let normal = self.board.quarter_turn(along);
        (speed.value() > 0.0).then_some(Station { point, path: PathOf::Free, at, normal })
    }

    /// The line square to the pole ray at the inflection point of a station.
    fn inflection_point(&mut self, link: LinkId, station: Station, pole: Point) -> Line {
        let Station { point, path, at, .. } = station;
        let reason = self.reason(&[link]);
        let (line, by) = match path {
            PathOf::Pivot(pivot) => {
                let centre = self.at(pivot);
                let ((through, along), proportion) = self.third_proportional(at, centre, pole, reason);
                (Line { through, along }, InflectionBy::Pivot { pivot, proportion })
            }
            PathOf::Guide(slide) => match self.track(slide, Some(point)) {
                Track::Straight(track) => {
                    (Line { through: at, along: track.along }, InflectionBy::Straight { slide })
                }
                Track::Arc(circle) => {
                    let centre = circle.centre;
                    let ((through, along), proportion) = self.third_proportional(at, centre, pole, reason);
                    (Line { through, along }, InflectionBy::Arc { slide, proportion })
                }
            },
            PathOf::Free => self.inflection_by_acceleration(link, point, pole),
        };
        self.aux_point(PointName::Inflection(point), line.through);
        self.act_auxiliary(AuxiliaryAct::InflectionPoint { link, point, by });
        line
    }

    /// AJ = Aⁿ / ω² toward the pole.
    fn inflection_by_acceleration(
        &mut self,
        link: LinkId,
        point: PointId,
        pole: Point,
    ) -> (Line, InflectionBy) {
        let at = self.at(point);
        let reason = self.reason(&[link]);
        let (ray, _) = self.board.toward(at, pole, reason);
        let origin = self.board.origin();
        let image = self.image(Order::Acceleration, point);
        let [along, _] = self.board.square_off(Line { through: origin, along: ray }, image);
        let scale = self.polygon_scale(Order::Acceleration);
        let normal = self.board.read(along, scale);
        let omega = self.rate(Order::Velocity, link);
        let once = self.board.quotient(normal, omega, reason);
        let twice = self.board.quotient(once, omega, reason);
        let length = self.length_scale();
        let mm = self.board.to_paper(twice, length);
        let through = self.board.lay_off(at, ray, mm);
        let along = self.board.quarter_turn(ray);
        (Line { through, along }, InflectionBy::Acceleration { normal: normal.value(), mm: mm.value() })
    }

    /// G on the circle: the foot of W on the line from P that is turned by φ from PW, tan φ = ε / ω².
    fn acceleration_centre(&mut self, link: LinkId, pole: Point, summit: Point) {
        let reason = self.reason(&[link]);
        let (omega, alpha) = (self.rate(Order::Velocity, link), self.rate(Order::Acceleration, link));
        let (normal, diameter) = self.board.toward(pole, summit, reason);
        let tangent = self.board.quarter_turn(normal);
        let square = self.board.product(omega, omega);
        let part = self.board.quotient(alpha, square, reason);
        let scale = self.length_scale();
        let real = self.board.read(diameter, scale);
        let off = self.board.product(part, real);
        let mm = self.board.to_paper(off, scale);
        let end = self.board.lay_off(summit, tangent, mm);
        let (ray, _) = self.board.toward(pole, end, reason);
        let centre = self.board.foot(Line { through: pole, along: ray }, summit);
        self.aux_line(pole, summit, StrokeRole::Axis, None);
        let beside = self.board.lay_off(pole, tangent, diameter);
        self.aux_line(pole, beside, StrokeRole::Axis, None);
        self.aux_line(pole, centre, StrokeRole::Image, None);
        self.aux_line(summit, centre, StrokeRole::Construction, None);
        self.aux_square(centre, pole, summit);
        self.aux_point(PointName::AccelerationCentre, centre);
        let angle = libm::atan(part.value());
        self.act_auxiliary(AuxiliaryAct::AccelerationCentre {
            link,
            omega: omega.value(),
            alpha: alpha.value(),
            angle,
        });
    }
}
