//! A workbench: mechanisms by hand, and readings of their answers.

use crate::analytic::{AnalyticError, State, solve};
use crate::mechanism::quantity::{Answer, Indeterminate, Order, Quantity};
use crate::mechanism::{
    Direction, Form, Given, Guide, GuidePoint, Input, Link, LinkId, Mechanism, Path, Pin, Place, Point,
    PointId, Rider, Roll, Slide,
};

/// A mechanism under construction. Lengths are metres, angles of inputs radians.
#[derive(Debug, Clone)]
pub(super) struct Bench {
    m: Mechanism,
}

pub(super) fn number(value: f64) -> Given {
    Given::read(value)
}

impl Bench {
    pub(super) fn new() -> Self {
        let frame =
            Link { number: 1, points: Vec::new(), form: Form::Placed, extra: Vec::new(), block: false };
        Self {
            m: Mechanism {
                links: vec![frame],
                points: Vec::new(),
                pins: Vec::new(),
                slides: Vec::new(),
                rolls: Vec::new(),
                contacts: Vec::new(),
                statements: Vec::new(),
                inputs: Vec::new(),
                forces: crate::mechanism::force::Forces::default(),
                asked: Vec::new(),
            },
        }
    }

    pub(super) fn point(&mut self, name: &str) -> PointId {
        if let Some(id) = self.m.point_named(name) {
            return id;
        }
        self.m.points.push(Point {
            name: name.into(),
            place: Place::Unknown,
            links: Vec::new(),
            journal: None,
        });
        PointId(self.m.points.len() - 1)
    }

    pub(super) fn fixed(mut self, name: &str, x: f64, y: f64) -> Self {
        let id = self.point(name);
        self.m.points[id.0].place = Place::Fixed([number(x), number(y)]);
        self.m.links[0].points.push(id);
        self
    }

    pub(super) fn placed(mut self, name: &str, x: f64, y: f64) -> Self {
        let id = self.point(name);
        self.m.points[id.0].place = Place::Placed([number(x), number(y)]);
        self
    }

    pub(super) fn near(mut self, name: &str, x: f64, y: f64) -> Self {
        let id = self.point(name);
        self.m.points[id.0].place = Place::Near([x, y]);
        self
    }

    pub(super) fn journal(mut self, name: &str, radius: f64) -> Self {
        let id = self.point(name);
        self.m.points[id.0].journal = Some(number(radius));
        self
    }

    pub(super) fn link(mut self, n: u32, joins: &[&str], form: Form) -> Self {
        let points = joins.iter().map(|name| self.point(name)).collect();
        self.m.links.push(Link { number: n, points, form, extra: Vec::new(), block: false });
        self
    }

    pub(super) fn bar(self, n: u32, from: &str, to: &str, length: f64) -> Self {
        self.link(n, &[from, to], Form::Length(number(length)))
    }

    pub(super) fn id(&self, n: u32) -> LinkId {
        self.m.link_numbered(n).unwrap()
    }

    /// A straight guide in link `n` through a point or own coordinates.
    pub(super) fn straight(&self, n: u32, through: Result<&str, [f64; 2]>, degrees: f64) -> Guide {
        let through = match through {
            Ok(name) => GuidePoint::Point(self.m.point_named(name).unwrap()),
            Err(own) => GuidePoint::Own(own.map(number)),
        };
        let radians = degrees.to_radians();
        let angle = Given::within(radians, radians.abs() * 2.0 * f64::EPSILON);
        Guide {
            link: self.id(n),
            path: Path::Straight {
                through,
                direction: Direction::Angle(angle),
                turned: Given::exact(0.0),
                offset: Given::exact(0.0),
            },
        }
    }

    pub(super) fn arc(&self, n: u32, centre: &str, radius: f64) -> Guide {
        let centre = GuidePoint::Point(self.m.point_named(centre).unwrap());
        Guide { link: self.id(n), path: Path::Arc { centre, radius: number(radius) } }
    }

    /// A pin, in a block where one is named, on a guide.
    pub(super) fn pin_slides(
        mut self,
        pin: &str,
        block: Option<u32>,
        guide: impl Fn(&Self) -> Guide,
    ) -> Self {
        let point = self.point(pin);
        let block = block.map(|n| {
            self.m.links.push(Link {
                number: n,
                points: vec![point],
                form: Form::Single,
                extra: Vec::new(),
                block: true,
            });
            LinkId(self.m.links.len() - 1)
        });
        let guide = guide(&self);
        self.m.slides.push(Slide { rider: Rider::Pin { point, block }, guide });
        self
    }

    pub(super) fn link_slides(mut self, n: u32, turned: Option<f64>, guide: impl Fn(&Self) -> Guide) -> Self {
        let rider = Rider::Link { link: self.id(n), turned: turned.map(number) };
        let guide = guide(&self);
        self.m.slides.push(Slide { rider, guide });
        self
    }

    pub(super) fn gears(
        mut self,
        links: [u32; 2],
        centres: [&str; 2],
        radii: [f64; 2],
        internal: bool,
    ) -> Self {
        let roll = Roll::Circles {
            links: links.map(|n| self.id(n)),
            centres: centres.map(|name| self.m.point_named(name).unwrap()),
            radii: radii.map(number),
            internal,
        };
        self.m.rolls.push(roll);
        self
    }

    pub(super) fn rack(
        mut self,
        wheel: u32,
        centre: &str,
        radius: f64,
        guide: impl Fn(&Self) -> Guide,
    ) -> Self {
        let roll = Roll::Line {
            guide: guide(&self),
            wheel: self.id(wheel),
            centre: self.m.point_named(centre).unwrap(),
            radius: number(radius),
        };
        self.m.rolls.push(roll);
        self
    }

    pub(super) fn drive(mut self, n: u32, angle: Option<f64>, omega: f64, alpha: f64) -> Self {
        let input = Input::Angle {
            link: self.id(n),
            angle: angle.map(number),
            omega: number(omega),
            alpha: number(alpha),
        };
        self.m.inputs.push(input);
        self
    }

    pub(super) fn push(mut self, slide: usize, at: Option<f64>, velocity: f64, acceleration: f64) -> Self {
        self.m.inputs.push(Input::Slide {
            slide,
            at: at.map(number),
            velocity: number(velocity),
            acceleration: number(acceleration),
        });
        self
    }

    pub(super) fn input(mut self, input: Input) -> Self {
        self.m.inputs.push(input);
        self
    }

    /// The finished mechanism: points know their links, and links are pinned where they share a point.
    pub(super) fn done(&self) -> Mechanism {
        let mut m = self.m.clone();
        m.links[1..].sort_by_key(|l| l.number);
        let old = |id: LinkId| self.m.links[id.0].number;
        let new = |id: LinkId| m.link_numbered(old(id)).unwrap();
        let (mut slides, mut rolls, mut inputs) = (m.slides.clone(), m.rolls.clone(), m.inputs.clone());
        for slide in &mut slides {
            slide.guide.link = new(slide.guide.link);
            match &mut slide.rider {
                Rider::Pin { block, .. } => *block = block.map(new),
                Rider::Link { link, .. } => *link = new(*link),
            }
        }
        for roll in &mut rolls {
            match roll {
                Roll::Circles { links, .. } => *links = links.map(new),
                Roll::Line { guide, wheel, .. } => {
                    guide.link = new(guide.link);
                    *wheel = new(*wheel);
                }
            }
        }
        for input in &mut inputs {
            match input {
                Input::Angle { link, .. } | Input::Speed { link, .. } => *link = new(*link),
                Input::Slide { .. } => {}
            }
        }
        (m.slides, m.rolls, m.inputs) = (slides, rolls, inputs);
        for index in 0..m.points.len() {
            let point = PointId(index);
            let links: Vec<LinkId> =
                (0..m.links.len()).map(LinkId).filter(|l| m.link(*l).points.contains(&point)).collect();
            m.pins.extend(links.windows(2).map(|pair| Pin { point, links: [pair[0], pair[1]] }));
            m.points[index].links = links;
        }
        m
    }

    pub(super) fn solve(&self) -> Solution {
        match self.try_solve() {
            Ok(solution) => solution,
            Err(error) => panic!("{error}"),
        }
    }

    pub(super) fn try_solve(&self) -> Result<Solution, AnalyticError> {
        let m = self.done();
        Ok(Solution { state: solve(&m, Order::Acceleration)?, m })
    }
}

pub(super) struct Solution {
    pub(super) m: Mechanism,
    pub(super) state: State,
}

impl Solution {
    pub(super) fn p(&self, name: &str) -> PointId {
        self.m.point_named(name).unwrap()
    }

    pub(super) fn l(&self, n: u32) -> LinkId {
        self.m.link_numbered(n).unwrap()
    }

    pub(super) fn scalar(&self, quantity: Quantity) -> f64 {
        self.bounded(quantity).0
    }

    pub(super) fn bounded(&self, quantity: Quantity) -> (f64, f64) {
        match self.state.answer(&quantity) {
            Answer::Scalar { value, bound } => (value, bound),
            other => panic!("{quantity:?}: {other:?}"),
        }
    }

    pub(super) fn vector(&self, quantity: Quantity) -> [f64; 2] {
        match self.state.answer(&quantity) {
            Answer::Vector { value, bound } => {
                assert!(bound.is_finite());
                value
            }
            other => panic!("{quantity:?}: {other:?}"),
        }
    }

    pub(super) fn vector_bound(&self, quantity: Quantity) -> f64 {
        match self.state.answer(&quantity) {
            Answer::Vector { bound, .. } => bound,
            other => panic!("{quantity:?}: {other:?}"),
        }
    }

    pub(super) fn length(&self, quantity: Quantity) -> f64 {
        let v = self.vector(quantity);
        libm::hypot(v[0], v[1])
    }

    pub(super) fn omega(&self, n: u32) -> f64 {
        self.scalar(Quantity::Omega(self.l(n)))
    }

    pub(super) fn alpha(&self, n: u32) -> f64 {
        self.scalar(Quantity::Alpha(self.l(n)))
    }

    pub(super) fn at(&self, name: &str) -> [f64; 2] {
        self.vector(Quantity::Position(self.p(name)))
    }

    pub(super) fn v(&self, name: &str) -> [f64; 2] {
        self.vector(Quantity::Velocity(self.p(name)))
    }

    pub(super) fn a(&self, name: &str) -> [f64; 2] {
        self.vector(Quantity::Acceleration(self.p(name)))
    }

    pub(super) fn refused(&self, quantity: Quantity) -> Indeterminate {
        match self.state.answer(&quantity) {
            Answer::Indeterminate(why) => why,
            other => panic!("{quantity:?} should be refused, not {other:?}"),
        }
    }
}

/// Fails unless the two numbers agree to the given absolute tolerance.
#[track_caller]
pub(super) fn near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "found {found}, expected {expected} ± {tolerance}");
}

/// The same for two vectors.
#[track_caller]
pub(super) fn both(found: [f64; 2], expected: [f64; 2], tolerance: f64) {
    near(found[0], expected[0], tolerance);
    near(found[1], expected[1], tolerance);
}
