//! Where guides lie on the paper: the drawing only, no solver's business.

use kurbo::{Point, Vec2};

use super::ink::page;
use crate::graphical::construction::Space;
use crate::mechanism::{
    Direction, Form, GuidePoint, Input, LinkId, Mechanism, Path, PointId, Rider, Sense, Slide,
};

/// The mechanism as it lies on the paper.
#[derive(Debug, Clone, Copy)]
pub struct Pose<'a> {
    mechanism: &'a Mechanism,
    space: &'a Space,
}

/// A frame of own coordinates on the page: own metres to page millimetres.
#[derive(Debug, Clone, Copy)]
struct Frame {
    origin: Point,
    x: Vec2,
}

/// A guide under its rider.
#[derive(Debug, Clone, Copy)]
pub enum GuideLine {
    /// A straight guide: the rider's place and the direction along the guide, a unit vector.
    Straight {
        /// Where the rider is.
        at: Point,
        /// Along the guide.
        along: Vec2,
    },
    /// An arc guide.
    Arc {
        /// Where the rider is.
        at: Point,
        /// Centre of curvature.
        centre: Point,
    },
}

impl<'a> Pose<'a> {
    /// The mechanism with its places on the paper.
    #[must_use]
    pub fn new(mechanism: &'a Mechanism, space: &'a Space) -> Self {
        Self { mechanism, space }
    }

    /// Place of a point on the page.
    #[must_use]
    pub fn place(&self, point: PointId) -> Option<Point> {
        self.space.places.get(point.0).copied().flatten().map(page)
    }

    /// Metres to page millimetres.
    #[must_use]
    pub fn paper(&self, metres: f64) -> f64 {
        metres / self.space.metres_per_mm
    }

    /// The points of a link that have a place, with it.
    #[must_use]
    pub fn places(&self, link: LinkId) -> Vec<(PointId, Point)> {
        let Some(link) = self.mechanism.links.get(link.0) else { return Vec::new() };
        link.points.iter().filter_map(|p| Some((*p, self.place(*p)?))).collect()
    }

    /// Own coordinates of each point of a link, in metres.
    fn own(&self, link: LinkId) -> Option<Vec<[f64; 2]>> {
        let link = self.mechanism.links.get(link.0)?;
        let own = match &link.form {
            Form::Length(l) => vec![[0.0, 0.0], [l.value, 0.0]],
            Form::Line(positions) => positions.iter().map(|p| [p.value, 0.0]).collect(),
            Form::Sides { first_second, second_third, third_first, turn } => {
                let (a, b, c) = (first_second.value, second_third.value, third_first.value);
                let x = (a * a + c * c - b * b) / (2.0 * a);
                let y = (c * c - x * x).max(0.0).sqrt();
                vec![[0.0, 0.0], [a, 0.0], [x, if *turn == Sense::Ccw { y } else { -y }]]
            }
            Form::Arms { second, third, angle } => {
                let (sin, cos) = libm::sincos(angle.value);
                vec![[0.0, 0.0], [second.value, 0.0], [third.value * cos, third.value * sin]]
            }
            Form::Shape(points) => points.iter().map(|p| [p[0].value, p[1].value]).collect(),
            Form::Placed => {
                let exact = |p: &PointId| {
                    match self.mechanism.points.get(p.0)?.place.exact() {
                        Some(place) => Some([place[0].value, place[1].value]),
                        // A stated place is known as it was drawn.
                        None => {
                            let away = self.place(*p)? - self.frame(LinkId::FRAME, 0)?.origin;
                            let metres = self.space.metres_per_mm;
                            Some([away.x * metres, -away.y * metres])
                        }
                    }
                };
                return link.points.iter().map(exact).collect();
            }
            Form::Single => vec![[0.0, 0.0]],
        };
        let extra = link.extra.iter().map(|own| own.map(|c| c.value));
        let own = own.into_iter().chain(extra).collect();
        Some(own)
    }

    /// The own frame of a link on the page; `None` where its points do not tell.
    /// `depth` counts guides carried by guides: a scene may close that ring.
    fn frame(&self, link: LinkId, depth: usize) -> Option<Frame> {
        if depth > self.mechanism.links.len() {
            return None;
        }
        let scale = 1.0 / self.space.metres_per_mm;
        let world_like =
            link == LinkId::FRAME || matches!(self.mechanism.links.get(link.0)?.form, Form::Placed);
        if world_like {
            // Own coordinates are the world's: any exact point that is drawn tells the origin. Without
            // one the world's origin is the drawing's.
            let known = self.mechanism.points.iter().enumerate().find_map(|(i, p)| {
                let exact = p.place.exact()?;
                Some((self.place(PointId(i))?, exact))
            });
            let origin = known
                .map_or(Point::ORIGIN, |(at, exact)| at - Vec2::new(exact[0].value, -exact[1].value) * scale);
            return Some(Frame { origin, x: Vec2::new(scale, 0.0) });
        }
        // As it was drawn, where that was needed.
        if let Some(axes) = self.space.axes.get(link.0).copied().flatten() {
            return Some(Frame { origin: page(axes.origin), x: Vec2::new(axes.x[0], -axes.x[1]) * scale });
        }
        let own = self.own(link)?;
        let points = &self.mechanism.links.get(link.0)?.points;
        let known: Vec<(Vec2, Point)> = points
            .iter()
            .zip(&own)
            .filter_map(|(p, o)| Some((Vec2::new(o[0], -o[1]), self.place(*p)?)))
            .collect();
        let (first, at) = *known.first()?;
        let far = known.iter().max_by(|a, b| (a.0 - first).hypot().total_cmp(&(b.0 - first).hypot()))?;
        let d = far.0 - first;
        if d.hypot() > 0.0 {
            // A similarity as a complex ratio: drawn difference over own difference.
            let drawn = far.1 - at;
            let x = Vec2::new(drawn.dot(d), d.cross(drawn)) / d.hypot2();
            let frame = Frame { origin: at, x };
            return Some(Frame { origin: at - frame.turn(first), x });
        }
        let angle = self.single_angle(link, depth)?;
        let (sin, cos) = libm::sincos(angle);
        Some(Frame { origin: at, x: Vec2::new(cos, -sin) * scale })
    }

    /// Direction of the own x-axis of a link with one joint, counter-clockwise on the page.
    fn single_angle(&self, link: LinkId, depth: usize) -> Option<f64> {
        for input in &self.mechanism.inputs {
            if let Input::Angle { link: l, angle: Some(angle), .. } = input
                && *l == link
            {
                return Some(angle.value);
            }
        }
        let joint = self.place(*self.mechanism.links.get(link.0)?.points.first()?)?;
        for slide in &self.mechanism.slides {
            // A swivelling guide looks towards its rider.
            if slide.guide.link == link
                && let Rider::Pin { point, .. } = slide.rider
                && let Some(rider) = self.place(point)
                && rider.distance(joint) > 1e-9
                && let Path::Straight { direction: Direction::Angle(angle), turned, .. } = slide.guide.path
            {
                let d = rider - joint;
                return Some(libm::atan2(-d.y, d.x) - angle.value - turned.value);
            }
            // A swivelling guide lies along the link that slides in it.
            if slide.guide.link == link
                && let Rider::Link { link: rod, turned } = slide.rider
                && rod != link
                && self.places(rod).len() > 1
                && let Path::Straight { direction: Direction::Angle(angle), turned: own, .. } =
                    slide.guide.path
                && let Some(frame) = self.frame(rod, depth + 1)
            {
                let x = libm::atan2(-frame.x.y, frame.x.x);
                return Some(x - turned.map_or(0.0, |t| t.value) - angle.value - own.value);
            }
            if let Rider::Link { link: l, turned } = slide.rider
                && l == link
                && slide.guide.link != link
                && let Some(along) = self.direction(slide, depth + 1)
            {
                return Some(libm::atan2(-along.y, along.x) + turned.map_or(0.0, |t| t.value));
            }
        }
        Some(0.0)
    }

    fn guide_point(&self, link: LinkId, point: GuidePoint, depth: usize) -> Option<Point> {
        match point {
            GuidePoint::Point(p) => self.place(p),
            GuidePoint::Own([x, y]) => {
                let frame = self.frame(link, depth)?;
                Some(frame.origin + frame.turn(Vec2::new(x.value, -y.value)))
            }
        }
    }

    /// Direction along a straight guide on the page, a unit vector.
    fn direction(&self, slide: &Slide, depth: usize) -> Option<Vec2> {
        let Path::Straight { through, direction, turned, .. } = slide.guide.path else { return None };
        let base = match direction {
            Direction::Angle(angle) => {
                let (sin, cos) = libm::sincos(angle.value + turned.value);
                self.frame(slide.guide.link, depth)?.turn(Vec2::new(cos, -sin))
            }
            Direction::Toward(target) => {
                let d = self.place(target)? - self.guide_point(slide.guide.link, through, depth)?;
                let (sin, cos) = libm::sincos(turned.value);
                Vec2::new(d.x * cos + d.y * sin, d.y * cos - d.x * sin)
            }
        };
        (base.hypot() > 0.0).then(|| base.normalize())
    }

    /// Where the rider of a sliding pair is.
    #[must_use]
    pub fn rider(&self, slide: &Slide) -> Option<Point> {
        match slide.rider {
            Rider::Pin { point, .. } => self.place(point),
            Rider::Link { link, .. } => self.place(*self.mechanism.links.get(link.0)?.points.first()?),
        }
    }

    /// The guide of a sliding pair under its rider.
    #[must_use]
    pub fn guide(&self, slide: &Slide) -> Option<GuideLine> {
        let at = self.rider(slide)?;
        match slide.guide.path {
            Path::Straight { .. } => Some(GuideLine::Straight { at, along: self.direction(slide, 0)? }),
            Path::Arc { centre, .. } => {
                Some(GuideLine::Arc { at, centre: self.guide_point(slide.guide.link, centre, 0)? })
            }
        }
    }

    /// Where a point stands through which a guide of a link goes.
    #[must_use]
    pub fn stands(&self, link: LinkId, point: GuidePoint) -> Option<Point> {
        self.guide_point(link, point, 0)
    }

    /// The own axes of a link: their origin and the unit vector along x.
    #[must_use]
    pub fn axes(&self, link: LinkId) -> Option<(Point, Vec2)> {
        let frame = self.frame(link, 0)?;
        Some((frame.origin, frame.x.normalize()))
    }

    /// The axis about which the plane of a governor turns: a point of it and its direction.
    #[must_use]
    pub fn axis_of_rotation(&self) -> Option<(Point, Vec2)> {
        let spin = self.mechanism.forces.spin.as_ref()?;
        let (sin, cos) = libm::sincos(spin.angle.value);
        let on = self.guide_point(LinkId::FRAME, GuidePoint::Own(spin.through), 0)?;
        Some((on, Vec2::new(cos, -sin)))
    }

    /// The line of a guide that a wheel rolls on: a point of it and its direction.
    #[must_use]
    pub fn track(&self, guide: crate::mechanism::Guide) -> Option<(Point, Vec2)> {
        let Path::Straight { through, offset, .. } = guide.path else { return None };
        let rider = Rider::Pin { point: PointId(usize::MAX), block: None };
        let along = self.direction(&Slide { rider, guide }, 0)?;
        let left = Vec2::new(along.y, -along.x);
        Some((self.guide_point(guide.link, through, 0)? + left * self.paper(offset.value), along))
    }
}

impl Frame {
    /// An own difference (y already down) as a difference on the page.
    fn turn(&self, own: Vec2) -> Vec2 {
        Vec2::new(self.x.x * own.x - self.x.y * own.y, self.x.y * own.x + self.x.x * own.y)
    }
}
