//! A mechanism as it stands at one instant: places first, no dimensions. What a scene says of it, `statement.rs` says.

/// A place, or components of a vector.
pub(crate) type Place = [f64; 2];

/// The frame.
pub(crate) const FRAME: usize = 0;

/// Why a body is there, which says how a scene may speak of it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Link 1.
    Frame,
    /// A link that a scene lists in `links`.
    Link,
    /// The block of a pin on a guide: only its number stands in `slides`.
    Block,
    /// A pin that no link joins, on two guides without a block: no link of the scene, and it does not turn.
    Particle,
}

/// A body.
#[derive(Clone, Debug)]
pub(crate) struct Body {
    pub(crate) kind: Kind,
    /// Its number in the scene.
    pub(crate) number: u32,
    /// Its points, in the order in which the scene lists them.
    pub(crate) joins: Vec<usize>,
}

/// A point of one or more bodies; of more, a pin.
#[derive(Clone, Debug)]
pub(crate) struct Point {
    pub(crate) name: String,
    pub(crate) at: Place,
    /// Bodies that have it.
    pub(crate) of: Vec<usize>,
}

/// Where a rider may go.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Path {
    /// A straight line through a place in a direction (unit vector).
    Line { through: Place, along: Place },
    /// A circle; its centre may be a point of the guiding body.
    Arc { centre: Place, point: Option<usize>, radius: f64 },
}

/// What slides.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rider {
    /// A pin, perhaps in a block.
    Pin { point: usize, block: Option<usize> },
    /// A link whose first joint is on the guide, and which does not turn against it.
    Link(usize),
}

/// A sliding pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Slide {
    pub(crate) rider: Rider,
    /// The body that carries the guide.
    pub(crate) on: usize,
    pub(crate) path: Path,
    /// How a scene must say the guide: the body has one joint, through which the guide passes, toward the rider.
    pub(crate) swivel: bool,
}

/// What rolls on what.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Contact {
    /// Two wheels about points of theirs.
    Wheels { centres: [usize; 2], radii: [f64; 2], internal: bool },
    /// The first body's straight line, and the second as a wheel.
    Rack { through: Place, along: Place, centre: usize, radius: f64 },
}

/// A rolling pair.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Roll {
    pub(crate) bodies: [usize; 2],
    pub(crate) contact: Contact,
    /// Nothing else holds the distance.
    pub(crate) keeps_distance: bool,
}

/// What drives.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Driver {
    /// A link, against the frame.
    Link(usize),
    /// A sliding pair, by its index.
    Slide(usize),
}

/// A driver with its rates: rad or lengths, by the scene's time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Input {
    pub(crate) driver: Driver,
    pub(crate) rate: f64,
    pub(crate) second: f64,
}

/// A mechanism.
#[derive(Clone, Debug)]
pub(crate) struct Mechanism {
    pub(crate) bodies: Vec<Body>,
    pub(crate) points: Vec<Point>,
    pub(crate) slides: Vec<Slide>,
    pub(crate) rolls: Vec<Roll>,
    pub(crate) inputs: Vec<Input>,
}

pub(crate) fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn plus(a: Place, b: Place, times: f64) -> Place {
    [a[0] + times * b[0], a[1] + times * b[1]]
}

pub(crate) fn dot(a: Place, b: Place) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn cross(a: Place, b: Place) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn length(a: Place) -> f64 {
    libm::hypot(a[0], a[1])
}

pub(crate) fn unit(a: Place) -> Place {
    let l = length(a);
    [a[0] / l, a[1] / l]
}

/// A quarter turn ccw.
pub(crate) fn left(a: Place) -> Place {
    [-a[1], a[0]]
}

/// Radians from +x.
pub(crate) fn angle(a: Place) -> f64 {
    libm::atan2(a[1], a[0])
}

pub(crate) fn direction(angle: f64) -> Place {
    let (s, c) = libm::sincos(angle);
    [c, s]
}

impl Mechanism {
    pub(crate) fn new() -> Self {
        Self {
            bodies: vec![Body { kind: Kind::Frame, number: 1, joins: vec![] }],
            points: vec![],
            slides: vec![],
            rolls: vec![],
            inputs: vec![],
        }
    }

    pub(crate) fn at(&self, point: usize) -> Place {
        self.points[point].at
    }

    pub(crate) fn is_fixed(&self, point: usize) -> bool {
        self.points[point].of.contains(&FRAME)
    }

    pub(crate) fn body(&mut self, kind: Kind) -> usize {
        let number = u32::try_from(self.bodies.len()).unwrap() + 1;
        self.bodies.push(Body { kind, number, joins: vec![] });
        self.bodies.len() - 1
    }

    /// A new point of a body.
    pub(crate) fn point(&mut self, body: usize, at: Place) -> usize {
        let index = self.points.len();
        let letter = char::from(b'A' + u8::try_from(index % 26).unwrap());
        let name = match index / 26 {
            0 => letter.to_string(),
            n => format!("{letter}{n}"),
        };
        self.points.push(Point { name, at, of: vec![] });
        self.join(body, index);
        index
    }

    /// Another body gets a point.
    pub(crate) fn join(&mut self, body: usize, point: usize) {
        self.points[point].of.push(body);
        if self.bodies[body].kind == Kind::Link {
            self.bodies[body].joins.push(point);
        }
    }

    /// The same mechanism elsewhere: `turn` in radians, mirrored at the x-axis first.
    pub(crate) fn moved(mut self, mirror: bool, turn: f64, scale: f64, shift: Place) -> Self {
        let x = direction(turn);
        let turned = |p: Place| {
            let y = if mirror { -p[1] } else { p[1] };
            [p[0] * x[0] - y * x[1], p[0] * x[1] + y * x[0]]
        };
        let moved = |p: Place| plus(shift, turned(p), scale);
        for point in &mut self.points {
            point.at = moved(point.at);
        }
        let line = |through: &mut Place, along: &mut Place| {
            *through = moved(*through);
            *along = turned(*along);
        };
        for slide in &mut self.slides {
            match &mut slide.path {
                Path::Line { through, along } => line(through, along),
                Path::Arc { centre, radius, .. } => {
                    *centre = moved(*centre);
                    *radius *= scale;
                }
            }
        }
        for roll in &mut self.rolls {
            match &mut roll.contact {
                Contact::Wheels { radii, .. } => radii.iter_mut().for_each(|r| *r *= scale),
                Contact::Rack { through, along, radius, .. } => {
                    line(through, along);
                    *radius *= scale;
                }
            }
        }
        self
    }

    /// The point of a slide's rider, and the body that carries it.
    pub(crate) fn rider(&self, slide: &Slide) -> (usize, usize) {
        match slide.rider {
            Rider::Pin { point, .. } => (point, self.points[point].of[0]),
            Rider::Link(body) => (self.bodies[body].joins[0], body),
        }
    }

    /// The largest distance between two points.
    pub(crate) fn size(&self) -> f64 {
        let mut size = 0.0_f64;
        for a in &self.points {
            for b in &self.points {
                size = size.max(length(minus(a.at, b.at)));
            }
        }
        size
    }
}
