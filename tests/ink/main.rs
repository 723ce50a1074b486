//! The ink is the computation: from the finished SVG alone, the ends of its vectors and its printed
//! scales, every asked quantity comes back within its bound and the last decimal of the drawing.
//!
//! What is taken from the scene is only what a reader of the exam question knows: which points belong to
//! which link, the dimensions of a straight link's own axis, the radius of a pin.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod forces;
mod reader;
use crate::{sheets, statements};

use std::collections::BTreeMap;
use std::sync::OnceLock;

use linkgram::mechanism::quantity::{Answer, Method, Order, Quantity};
use linkgram::mechanism::{Form, LinkId, Mechanism, Path, PointId, Rider, Roll};
use linkgram::plan::transmission_points;
use linkgram::scene::Scene;
use linkgram::solve::Solved;
use reader::{Claim, Mm2, Polygon, Sheet, Vector, minus};

/// Both ends of a stroke are written to 6 decimals of a millimetre: each coordinate of their difference
/// errs by at most this.
const LAST: f64 = 1e-6;
/// The same for the length of the difference.
const DIAGONAL: f64 = std::f64::consts::SQRT_2 * LAST;

/// A quantity as read off the sheet.
enum Read {
    /// SI components and the reading error of each.
    Vector(Mm2, f64),
    /// SI value and reading error.
    Scalar(f64, f64),
    /// Cannot be read, and why that is in order.
    Exempt(String),
}

/// What stands in one sheet, with the mechanism's list of parts.
struct Reading<'a> {
    sheet: &'a Sheet,
    mechanism: &'a Mechanism,
}

impl Reading<'_> {
    fn name(&self, point: PointId) -> &str {
        &self.mechanism.point(point).name
    }

    fn joint(&self, point: PointId) -> Mm2 {
        let name = self.name(point);
        *self.sheet.joints.get(name).unwrap_or_else(|| panic!("the skeleton has no {name}"))
    }

    fn polygon(&self, order: Order) -> &Polygon {
        let polygon = match order {
            Order::Acceleration => &self.sheet.acceleration,
            _ => &self.sheet.velocity,
        };
        polygon.as_ref().expect("the polygon is drawn")
    }

    /// The name of a quantity of a pin and a link: `slip(A/4)`, `v(A@4)`.
    fn pair(&self, letter: &str, pin: PointId, between: char, link: LinkId) -> String {
        format!("{letter}({}{between}{})", self.name(pin), self.mechanism.link(link).number)
    }

    /// A vector of a polygon by the name of its quantity.
    fn vector(&self, order: Order, name: &str) -> Read {
        let polygon = self.polygon(order);
        let vector = polygon.vector(name).unwrap_or_else(|| panic!("no vector stands for {name}"));
        match vector.along() {
            Some(along) => Read::Vector(along.map(|mm| mm * polygon.scale), LAST * polygon.scale),
            None => Read::Exempt(format!("{name} is drawn as a point")),
        }
    }

    fn read(&self, quantity: Quantity) -> Read {
        let n = |p| self.name(p);
        let (first, second) = (Order::Velocity, Order::Acceleration);
        match quantity {
            Quantity::Velocity(b) => self.vector(first, &format!("v({})", n(b))),
            Quantity::RelativeVelocity(b, a) => self.vector(first, &format!("v({}/{})", n(b), n(a))),
            Quantity::Acceleration(b) => self.vector(second, &format!("a({})", n(b))),
            Quantity::RelativeAcceleration(b, a) => self.vector(second, &format!("a({}/{})", n(b), n(a))),
            Quantity::Normal(b) => self.vector(second, &format!("an({})", n(b))),
            Quantity::Tangential(b) => self.vector(second, &format!("at({})", n(b))),
            Quantity::RelativeNormal(b, a) => self.vector(second, &format!("an({}/{})", n(b), n(a))),
            Quantity::RelativeTangential(b, a) => self.vector(second, &format!("at({}/{})", n(b), n(a))),
            Quantity::Omega(link) => self.rate(first, link),
            Quantity::Alpha(link) => self.rate(second, link),
            Quantity::RelativeOmega(i, j) => difference(self.rate(first, i), self.rate(first, j)),
            Quantity::RelativeAlpha(i, j) => difference(self.rate(second, i), self.rate(second, j)),
            Quantity::Rub(pin, i, j) => self.rub(pin, i, j),
            Quantity::Position(p) => self.position(p),
            Quantity::Centre(i, j) => self.centre(i, j),
            Quantity::Angle(link) => self.angle(link),
            Quantity::Transmission(i, j) => self.transmission(i, j),
            Quantity::Slip(p, l) => self.vector(first, &self.pair("slip", p, '/', l)),
            Quantity::Coriolis(p, l) => self.vector(second, &self.pair("coriolis", p, '/', l)),
            Quantity::SlipAcceleration(p, l) => self.vector(second, &self.pair("aslip", p, '/', l)),
            Quantity::SlipNormal(p, l) => self.vector(second, &self.pair("aslipn", p, '/', l)),
            Quantity::SlipTangential(p, l) => self.vector(second, &self.pair("aslipt", p, '/', l)),
            Quantity::CoincidentVelocity(p, l) => self.vector(first, &self.pair("v", p, '@', l)),
            Quantity::CoincidentAcceleration(p, l) => self.vector(second, &self.pair("a", p, '@', l)),
            Quantity::CoincidentNormal(p, l) => self.vector(second, &self.pair("an", p, '@', l)),
            Quantity::CoincidentTangential(p, l) => self.vector(second, &self.pair("at", p, '@', l)),
            other => panic!("{other:?} is not read off sheets yet"),
        }
    }

    /// ω = V / l or α = Aᵗ / l with its sense: r × V / r², from the first pair of points whose vector is
    /// drawn long enough, the tangential part where there is one.
    fn rate(&self, order: Order, link: LinkId) -> Read {
        if link == LinkId::FRAME {
            return Read::Scalar(0.0, 0.0);
        }
        // A block turns with the guide on which it rides.
        if let Some(guide) = self.straight_guide_of(link) {
            return self.rate(order, guide);
        }
        if let Some((pin, guide, radius)) = self.arc_ridden_by(link) {
            return sum(self.turn_about_arc(order, pin, guide, radius), self.rate(order, guide));
        }
        let letters: &[&str] = if order == Order::Acceleration { &["at", "a"] } else { &["v"] };
        let polygon = self.polygon(order);
        let mut as_point = None;
        for letter in letters {
            for (name, arm) in self.arms(link, letter) {
                let Some(vector) = polygon.vector(&name) else { continue };
                match vector.along() {
                    Some(along) => return self.turn(arm, along, polygon.scale),
                    None => as_point = Some(name),
                }
            }
        }
        match as_point {
            Some(name) => Read::Exempt(format!("{name} is drawn as a point")),
            None => self.turn_of_wheel(order, link),
        }
    }

    /// The names that a vector about a point of a link may have, and the arm of each on the skeleton: to
    /// another of its points, or to its point under a pin that rides on it.
    fn arms(&self, link: LinkId, letter: &str) -> Vec<(String, Mm2)> {
        let points = &self.mechanism.link(link).points;
        let number = self.mechanism.link(link).number;
        let own = points.iter().map(|&b| (b, self.name(b).to_owned()));
        // Whatever rides on the link may have a point of it below: most of these names stand nowhere.
        let all = (0..self.mechanism.points.len()).map(PointId);
        let riders = all.filter(|&b| self.sheet.joints.contains_key(self.name(b)));
        let under = riders.map(|b| (b, format!("{}@{number}", self.name(b))));
        let ends: Vec<(PointId, String)> = own.chain(under).collect();
        let mut arms = Vec::new();
        for &a in points {
            for (b, b_name) in ends.iter().filter(|(b, _)| *b != a) {
                let name = if self.mechanism.is_fixed(a) {
                    format!("{letter}({b_name})")
                } else {
                    format!("{letter}({b_name}/{})", self.name(a))
                };
                arms.push((name, minus(self.joint(*b), self.joint(a))));
            }
        }
        // Where no own point's motion is known first, the point under a rider's pin takes that part.
        for slide in self.mechanism.slides.iter().filter(|s| s.guide.link == link) {
            let Rider::Pin { point: under, .. } = slide.rider else { continue };
            for &b in points.iter().filter(|&&b| b != under) {
                let name = format!("{letter}({}@{number}/{}@{number})", self.name(b), self.name(under));
                arms.push((name, minus(self.joint(b), self.joint(under))));
            }
        }
        arms
    }

    /// r × v / r² and what the last decimals can do to it.
    fn turn(&self, arm: Mm2, along: Mm2, scale: f64) -> Read {
        let r = libm::hypot(arm[0], arm[1]) * self.sheet.length;
        let v = libm::hypot(along[0], along[1]) * scale;
        let value = (arm[0] * along[1] - arm[1] * along[0]) * self.sheet.length * scale / (r * r);
        let by_vector = DIAGONAL * scale / r;
        let by_arm = (v / r + 2.0 * value.abs()) * DIAGONAL * self.sheet.length / r;
        Read::Scalar(value, by_vector + by_arm)
    }

    fn rub(&self, pin: PointId, i: LinkId, j: LinkId) -> Read {
        let radius = self.mechanism.point(pin).journal.expect("a rubbing pin has a radius").value;
        match difference(self.rate(Order::Velocity, i), self.rate(Order::Velocity, j)) {
            Read::Scalar(value, slack) => Read::Scalar(radius * value.abs(), radius * slack),
            other => other,
        }
    }

    /// The link on whose straight guide a block or a sliding link rides.
    fn straight_guide_of(&self, link: LinkId) -> Option<LinkId> {
        let ride = self.mechanism.slides.iter().find(|s| match s.rider {
            Rider::Pin { block, .. } => block == Some(link),
            Rider::Link { link: rider, .. } => rider == link,
        })?;
        matches!(ride.guide.path, Path::Straight { .. }).then_some(ride.guide.link)
    }

    /// How fast a wheel turns: what its point at a contact has beyond its centre.
    fn turn_of_wheel(&self, order: Order, wheel: LinkId) -> Read {
        let number = self.mechanism.link(wheel).number;
        let (contact, centre, radius) = self
            .mechanism
            .rolls
            .iter()
            .zip(&self.mechanism.contacts)
            .find_map(|(roll, &contact)| match roll {
                Roll::Circles { links, centres, radii, .. } => {
                    links.iter().position(|&l| l == wheel).map(|k| (contact, centres[k], radii[k]))
                }
                Roll::Line { wheel: w, centre, radius, .. } => {
                    (*w == wheel).then_some((contact, *centre, *radius))
                }
            })
            .unwrap_or_else(|| panic!("no vector tells how link {number} turns"));
        let polygon = self.polygon(order);
        let arm = self.radius_along(minus(self.joint(contact), self.joint(centre)), radius.value);
        // On a straight line at rest the centre keeps its distance: what it has is what turning about the contact gives.
        let on_line = self.mechanism.rolls.iter().any(
            |roll| matches!(roll, Roll::Line { wheel: w, guide, .. } if *w == wheel && guide.link == LinkId::FRAME),
        );
        let own = format!("a({})", self.name(centre));
        if let (Order::Acceleration, true, Some(vector)) = (order, on_line, polygon.vector(&own)) {
            return match vector.along() {
                Some(along) => self.turn(arm.map(|mm| -mm), along, polygon.scale),
                None => Read::Exempt(format!("{own} is drawn as a point")),
            };
        }
        let along = |name: &str| {
            let vector = polygon.vector(name).unwrap_or_else(|| panic!("no vector stands for {name}"));
            vector.along().ok_or_else(|| Read::Exempt(format!("{name} is drawn as a point")))
        };
        let beyond = match order {
            // Both begin in the image of the wheel's centre, not in the pole.
            Order::Acceleration => along(&self.pair("at", contact, '@', wheel)),
            _ => along(&self.pair("v", contact, '@', wheel)),
        };
        match beyond {
            Ok(along) => self.turn(arm, along, polygon.scale),
            Err(exempt) => exempt,
        }
    }

    /// A radius of the question on paper: arcs and the points on them are drawn to three decimals only, which
    /// is enough for the direction of what stands square to them.
    fn radius_along(&self, drawn: Mm2, metres: f64) -> Mm2 {
        let by = metres / self.sheet.length / libm::hypot(drawn[0], drawn[1]);
        drawn.map(|mm| mm * by)
    }

    /// The pin of a block that turns with the radius of an arc, the link that carries the arc, and its radius.
    fn arc_ridden_by(&self, link: LinkId) -> Option<(PointId, LinkId, f64)> {
        self.mechanism.slides.iter().find_map(|s| match (&s.rider, &s.guide.path) {
            (Rider::Pin { point, block: Some(block) }, Path::Arc { radius, .. }) if *block == link => {
                Some((*point, s.guide.link, radius.value))
            }
            _ => None,
        })
    }

    /// How fast the radius to a pin turns against its arc: the slip, or its tangential part, about the centre.
    fn turn_about_arc(&self, order: Order, pin: PointId, guide: LinkId, radius: f64) -> Read {
        let name = match order {
            Order::Acceleration => self.pair("aslipt", pin, '/', guide),
            _ if guide == LinkId::FRAME => format!("v({})", self.name(pin)),
            _ => self.pair("slip", pin, '/', guide),
        };
        let polygon = self.polygon(order);
        let vector = polygon.vector(&name).unwrap_or_else(|| panic!("no vector stands for {name}"));
        let Some(along) = vector.along() else { return Read::Exempt(format!("{name} is drawn as a point")) };
        let ridden = format!("guide {}/{}", self.name(pin), self.mechanism.link(guide).number);
        let [x, y] = self.sheet.line(&ridden);
        self.turn(self.radius_along([y, -x], radius), along, polygon.scale)
    }

    /// An instant centre, where its dot is on the sheet: neither at a pin, nor beyond the border, nor at infinity.
    fn centre(&self, i: LinkId, j: LinkId) -> Read {
        let [i, j] = [i.min(j), i.max(j)].map(|l| self.mechanism.link(l).number);
        match self.sheet.centres.get(&format!("({i}{j})")) {
            Some(at) => match self.in_world(*at) {
                Read::Vector(at, last) => Read::Vector(at, last.max(LAST * self.sheet.length_of_centres)),
                other => other,
            },
            None => Read::Exempt(format!("I({i},{j}) has no dot on the sheet")),
        }
    }

    fn position(&self, p: PointId) -> Read {
        self.in_world(self.joint(p))
    }

    fn in_world(&self, place: Mm2) -> Read {
        let exact = |p: PointId| self.mechanism.point(p).place.exact().map(|at| at.map(|g| g.value));
        let all = (0..self.mechanism.points.len()).map(PointId);
        let known =
            all.filter(|&p| self.sheet.joints.contains_key(self.name(p))).find_map(|p| Some((p, exact(p)?)));
        let Some((base, at)) = known else {
            return Read::Exempt("no point of the skeleton has coordinates".to_owned());
        };
        let [x, y] = minus(place, self.joint(base)).map(|mm| mm * self.sheet.length);
        Read::Vector([at[0] + x, at[1] + y], LAST * self.sheet.length)
    }

    /// Angle of the link's own x-axis: along rising positions of a straight link, from the first joint to
    /// the second, or from the one joint of a swivelling guide to the pin that rides on it.
    fn angle(&self, id: LinkId) -> Read {
        let link = self.mechanism.link(id);
        let rider = self.mechanism.slides.iter().find_map(|s| match s.rider {
            _ if s.guide.link != id => None,
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied(),
        });
        let (from, to) = match (&link.form, rider) {
            (Form::Line(positions), _) => {
                let order = |a: &usize, b: &usize| positions[*a].value.total_cmp(&positions[*b].value);
                let first = (0..positions.len()).min_by(order).unwrap();
                let last = (0..positions.len()).max_by(order).unwrap();
                (link.points[first], link.points[last])
            }
            (Form::Length(_) | Form::Sides { .. } | Form::Arms { .. }, _) => (link.points[0], link.points[1]),
            (Form::Shape(_), _) => (link.points[0], link.points[1]),
            (Form::Single, Some(rider)) => (link.points[0], rider),
            // Nothing on the sheet shows how far a wheel has turned.
            (Form::Single, None) => return Read::Exempt("the own axis of a wheel is not drawn".to_owned()),
            (other, _) => panic!("the own axis of {other:?} is not read off sheets"),
        };
        let axis = minus(self.joint(to), self.joint(from));
        // The direction that this line has in the link's own coordinates.
        let own = match &link.form {
            Form::Shape(places) => {
                let [x, y] = [0, 1].map(|k| places[1][k].value - places[0][k].value);
                libm::atan2(y, x)
            }
            _ => 0.0,
        };
        let turned = libm::remainder(libm::atan2(axis[1], axis[0]) - own, std::f64::consts::TAU);
        Read::Scalar(turned, DIAGONAL / libm::hypot(axis[0], axis[1]))
    }

    fn transmission(&self, i: LinkId, j: LinkId) -> Read {
        let [pin, p, q] = transmission_points(self.mechanism, i, j).map(|p| self.joint(p.unwrap()));
        let (a, b) = (minus(p, pin), minus(q, pin));
        let value = libm::atan2((a[0] * b[1] - a[1] * b[0]).abs(), a[0] * b[0] + a[1] * b[1]);
        Read::Scalar(value, DIAGONAL / libm::hypot(a[0], a[1]) + DIAGONAL / libm::hypot(b[0], b[1]))
    }
}

fn sum(a: Read, b: Read) -> Read {
    match b {
        Read::Scalar(value, error) => difference(a, Read::Scalar(-value, error)),
        other => difference(a, other),
    }
}

fn difference(a: Read, b: Read) -> Read {
    match (a, b) {
        (Read::Scalar(a, error_a), Read::Scalar(b, error_b)) => Read::Scalar(a - b, error_a + error_b),
        (Read::Exempt(why), _) | (_, Read::Exempt(why)) => Read::Exempt(why),
        _ => unreachable!("rates are scalars"),
    }
}

/// How far a reading is from an answer, as a part of what it may be: the answer's bound and the reading's
/// own error.
fn ratio(read: &Read, answer: &Answer) -> f64 {
    // What double arithmetic in this test itself may add.
    let part = |off: f64, bound: f64, slack: f64, size: f64| {
        if off == 0.0 { 0.0 } else { off / (bound + slack + 1e-15 * size) }
    };
    match (read, answer) {
        (Read::Vector(read, slack), Answer::Vector { value, bound }) => {
            let of = |k: usize| part((read[k] - value[k]).abs(), *bound, *slack, value[k].abs());
            of(0).max(of(1))
        }
        (Read::Scalar(read, slack), Answer::Scalar { value, bound }) => {
            part((read - value).abs(), *bound, *slack, value.abs())
        }
        _ => f64::INFINITY,
    }
}

/// A scene and its finished sheet.
struct Case {
    name: String,
    scene: Scene,
    solved: Solved,
    svg: String,
}

/// A slotted lever: the guide turns, so there are coincident points and a Coriolis vector.
const SLOTTED_LEVER: &str = r#"{
  "units": { "length": "mm" },
  "fixed": { "O2": [0, 0], "O4": [0, -200] },
  "links": {
    "2": { "joins": ["O2", "A"], "length": 80 },
    "4": { "joins": ["O4", "C"], "length": 500 },
    "5": { "joins": ["C", "D"], "length": 120 }
  },
  "slides": [
    { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "C" } },
    { "pin": "D", "block": 6, "on": { "link": 1, "through": [0, 280], "angle": 0 } }
  ],
  "near": { "C": [118, 286], "D": [238, 280] },
  "input": { "link": 2, "angle": 40, "omega": "10 rad/s ccw" },
  "find": [
    "v(A)", "slip(A/4)", "v(C)", "v(D)", "omega(3)", "omega(4)", "omega(5)", "a(C)", "a(D)", "coriolis(A/4)",
    "aslip(A/4)", "alpha(4)", "alpha(5)", "angle(4)", "x(D)"
  ]
}"#;

/// Seeds of random statements whose claims are measured as well.
const STATEMENTS: std::ops::Range<u64> = 0..16;

/// Sheets of random mechanisms, drawn once for all tests.
fn random() -> &'static [Case] {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    CASES.get_or_init(|| {
        let text = |seed| Some((format!("statement {seed}"), statements::right_scene(seed)?));
        let draw = |(name, text): (String, String)| {
            let (scene, solved, svg) = sheets::draw_text(&name, &text);
            Case { name, scene, solved, svg }
        };
        STATEMENTS.filter_map(text).map(draw).collect()
    })
}

/// All examples, drawn once for all tests.
fn cases() -> &'static [Case] {
    static CASES: OnceLock<Vec<Case>> = OnceLock::new();
    CASES.get_or_init(draw_all)
}

fn draw_all() -> Vec<Case> {
    let drawn =
        |name: String, (scene, solved, svg): (Scene, Solved, String)| Case { name, scene, solved, svg };
    let mut all: Vec<Case> =
        sheets::examples().into_iter().map(|e| drawn(e.name.clone(), sheets::draw(&e))).collect();
    let name = "a slotted lever".to_owned();
    all.push(drawn(name.clone(), sheets::draw_text(&name, SLOTTED_LEVER)));
    all
}

#[test]
fn the_sheet_gives_back_every_asked_quantity() {
    let mut failures = Vec::new();
    let (mut recovered, mut exempt) = (0, 0);
    for Case { name, scene, solved, svg } in cases() {
        let sheet = Sheet::read(svg);
        let reading = Reading { sheet: &sheet, mechanism: &scene.mechanism };
        let state = linkgram::solve::solve_analytically(scene).unwrap();
        for (asked, drawn) in scene.mechanism.asked.iter().zip(&solved.solution.construction.answers) {
            let read = match asked.method {
                Method::Polygon => reading.read(asked.quantity),
                other => Read::Exempt(format!("asked by the method {}", other.name())),
            };
            if let Read::Exempt(why) = &read {
                println!("{name}: {} is exempt: {why}", asked.name);
                exempt += 1;
                continue;
            }
            recovered += 1;
            // The drawing itself, and the solver that never saw it.
            for (by, answer) in [("drawn", &drawn.answer), ("analytic", &state.answer(&asked.quantity))] {
                let ratio = ratio(&read, answer);
                if ratio > 1.0 || ratio.is_nan() {
                    failures.push(format!("{name}: {} is {ratio} bounds off ({by})", asked.name));
                }
            }
        }
    }
    println!("{recovered} quantities recovered, {exempt} exempt");
    assert!(recovered > 200, "{recovered}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// Points of other links stand under a pin here, and a part against the pin is drawn that nobody asked: it begins in the
/// pin's own image.
const UNDER_A_PIN: [&str; 3] = [
    r#"{
      "units": { "length": "mm" },
      "fixed": { "O2": [0, 0], "O4": [0, -100] },
      "placed": { "A": [30, 40], "P": [50, 10], "B": [60, 180] },
      "links": { "2": { "joins": ["O2", "A", "P"] }, "4": { "joins": ["O4", "B"] } },
      "slides": [ { "pin": "A", "block": 3, "on": { "link": 4, "through": "O4", "toward": "B" } } ],
      "input": { "link": 4, "omega": 5 },
      "find": ["a(P/A)", "alpha(4)"]
    }"#,
    r#"{
      "units": { "length": "mm" },
      "fixed": { "O2": [0, 0], "O4": [100, 0] },
      "placed": { "A": [20, 40], "B": [100, 70], "T": [-30, 60], "G": [40, 110], "C": [-60, -20] },
      "links": { "2": { "joins": ["O2", "A", "C"] }, "3": { "joins": ["A", "B"] }, "4": { "joins": ["O4", "B"] },
                 "5": { "joins": ["B", "T", "G"] } },
      "slides": [ { "pin": "T", "on": { "link": 2, "through": [-30, 60], "angle": 20 } } ],
      "input": { "link": 2, "omega": 10 },
      "find": ["a(G)", "alpha(5)"]
    }"#,
    r#"{
      "units": { "length": "mm" },
      "fixed": { "J": [0, 0], "Y": [124.3, 24.5] },
      "near": { "B": [-50, 24], "D": [211, 25] },
      "links": { "2": { "joins": ["J", "B"], "length": 54.5 }, "3": { "joins": ["B", "D"], "length": 261 } },
      "slides": [ { "pin": "Y", "block": 4, "on": { "link": 3, "through": "B", "toward": "D" } } ],
      "input": { "link": 2, "angle": 155, "omega": -18 },
      "find": ["v(D)", "omega(3)", "a(D)"]
    }"#,
];

/// By its name every quantity that a vector of a polygon may stand for.
fn by_name(mechanism: &Mechanism) -> BTreeMap<String, Quantity> {
    let points: Vec<PointId> = (0..mechanism.points.len()).map(PointId).collect();
    let links: Vec<LinkId> = (0..mechanism.links.len()).map(LinkId).collect();
    let own = points.iter().flat_map(|&b| {
        [Quantity::Velocity(b), Quantity::Acceleration(b), Quantity::Normal(b), Quantity::Tangential(b)]
    });
    let relative = points.iter().flat_map(|&b| points.iter().map(move |&a| (b, a))).flat_map(|(b, a)| {
        [
            Quantity::RelativeVelocity(b, a),
            Quantity::RelativeAcceleration(b, a),
            Quantity::RelativeNormal(b, a),
            Quantity::RelativeTangential(b, a),
        ]
    });
    let under = points.iter().flat_map(|&b| links.iter().map(move |&l| (b, l))).flat_map(|(b, l)| {
        [
            Quantity::CoincidentVelocity(b, l),
            Quantity::CoincidentAcceleration(b, l),
            Quantity::CoincidentNormal(b, l),
            Quantity::CoincidentTangential(b, l),
            Quantity::Slip(b, l),
            Quantity::SlipAcceleration(b, l),
            Quantity::SlipNormal(b, l),
            Quantity::SlipTangential(b, l),
            Quantity::Coriolis(b, l),
        ]
    });
    own.chain(relative).chain(under).map(|quantity| (quantity.name(mechanism), quantity)).collect()
}

/// Whether or not anybody asked for it, a vector is what the other solver makes of its name.
#[test]
fn every_vector_is_what_it_is_called() {
    let texts = UNDER_A_PIN.into_iter().enumerate();
    let under: Vec<Case> = texts
        .map(|(number, text)| {
            let name = format!("under a pin {number}");
            let (scene, solved, svg) = sheets::draw_text(&name, text);
            Case { name, scene, solved, svg }
        })
        .collect();
    let mut failures = Vec::new();
    let (mut compared, mut untold) = (0, 0);
    for Case { name: case, scene, svg, .. } in under.iter().chain(cases()).chain(random()) {
        let sheet = Sheet::read(svg);
        let named = by_name(&scene.mechanism);
        let state = linkgram::solve::solve_analytically(scene).unwrap();
        for polygon in [&sheet.velocity, &sheet.acceleration].into_iter().flatten() {
            let longest = polygon.vectors.iter().filter_map(Vector::along).map(|[x, y]| libm::hypot(x, y));
            let longest = longest.fold(0.0, f64::max) * polygon.scale;
            for vector in &polygon.vectors {
                // The part that a link's turning gives the point under a pin has the name of the whole, and begins elsewhere.
                let is_part =
                    vector.quantity.contains('@') && !["o", "o\u{2032}"].contains(&vector.tail.as_str());
                let quantity = named.get(&vector.quantity).filter(|_| !is_part);
                let (Some(quantity), Some(along)) = (quantity, vector.along()) else {
                    untold += 1;
                    continue;
                };
                let Answer::Vector { value, bound } = state.answer(quantity) else {
                    untold += 1;
                    continue;
                };
                compared += 1;
                // Parts of a sum may be far larger than the vector: their last digits are its own.
                let room = bound + 2.0 * LAST * polygon.scale + 1e-9 * longest;
                let off = (0..2).map(|k| (along[k] * polygon.scale - value[k]).abs()).fold(0.0, f64::max);
                if off > room || off.is_nan() {
                    failures.push(format!("{case}: {} is {off:e} off {value:?}", vector.quantity));
                }
            }
        }
    }
    println!("{compared} vectors compared, {untold} without a name of their own");
    assert!(compared > 400 && untold < compared / 4, "{compared}, {untold}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

#[test]
fn every_claimed_direction_is_true() {
    let mut failures = Vec::new();
    let mut claims = 0;
    for Case { name, svg, .. } in cases().iter().chain(random()) {
        let sheet = Sheet::read(svg);
        // A part that is asked for beside the construction lies between two images and claims nothing.
        let constructed = !name.starts_with("statement");
        let mut check = |what: &str, along: Mm2, claim: &Claim| {
            claims += 1;
            let line = sheet.line(&claim.line);
            let (cross, dot) =
                (line[0] * along[1] - line[1] * along[0], line[0] * along[0] + line[1] * along[1]);
            let off = if claim.perpendicular { libm::atan2(dot, cross) } else { libm::atan2(cross, dot) };
            // A direction and its opposite are one.
            let off = libm::remainder(off, std::f64::consts::PI).abs();
            let allowed = 1e-6 + LAST / libm::hypot(along[0], along[1]);
            if off > allowed || off.is_nan() {
                failures.push(format!("{name}: {what} is {off:e} rad off {claim:?}"));
            }
        };
        for polygon in [&sheet.velocity, &sheet.acceleration].into_iter().flatten() {
            for vector in &polygon.vectors {
                match (&vector.claim, vector.along()) {
                    (Some(claim), Some(along)) => check(&vector.quantity, along, claim),
                    (Some(_), None) => println!("{name}: {} is drawn as a point", vector.quantity),
                    (None, _) => assert!(
                        !constructed || vector.kind != "normal" && vector.kind != "tangential",
                        "{name}: the part {} claims no direction",
                        vector.quantity
                    ),
                }
            }
            for ray in &polygon.rays {
                match &ray.claim {
                    Some(claim) => check("a construction line", minus(ray.ends[1], ray.ends[0]), claim),
                    None => assert!(on_trial_line(polygon, ray.ends), "{name}: a line claims no direction"),
                }
            }
        }
    }
    println!("{claims} claimed directions measured");
    assert!(claims > 200, "{claims}");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

/// A line of unknown length has a known direction, but for the line of trial images: it leads through the
/// image of either trial and through the image that was sought.
fn on_trial_line(polygon: &Polygon, [from, to]: [Mm2; 2]) -> bool {
    let along = minus(to, from);
    let length = libm::hypot(along[0], along[1]);
    let beside = |p: &Mm2| {
        let off = minus(*p, from);
        ((along[0] * off[1] - along[1] * off[0]) / length).abs()
    };
    polygon.images.values().flatten().filter(|p| beside(p) < 4.0 * LAST).count() >= 3
}

/// Polygons close: every vector begins and ends in the image points that it names.
#[test]
fn vectors_join_the_points_they_name() {
    for Case { name: case, svg, .. } in cases().iter().chain(random()) {
        let sheet = Sheet::read(svg);
        for polygon in [&sheet.velocity, &sheet.acceleration].into_iter().flatten() {
            for vector in &polygon.vectors {
                let Some(ends) = vector.ends else { continue };
                for (name, end) in [&vector.tail, &vector.head].into_iter().zip(ends) {
                    let images = polygon.images.get(name);
                    let images = images.unwrap_or_else(|| panic!("{case}: no image {name}"));
                    let meets = |image: &Mm2| minus(end, *image).iter().all(|d| d.abs() <= LAST);
                    assert!(images.iter().any(meets), "{case}: {} does not meet {name}", vector.quantity);
                }
            }
        }
    }
}

/// A reader that cannot see an error proves nothing: a vector moved by 0.01 mm, a wrong printed scale and
/// a turned line are found.
#[test]
fn a_wrong_sheet_is_not_accepted() {
    let example = sheets::examples().into_iter().find(|e| e.name == "s000-ch3a-1").unwrap();
    let (scene, solved, svg) = sheets::draw(&example);
    let worst = |svg: &str| {
        let sheet = Sheet::read(svg);
        let reading = Reading { sheet: &sheet, mechanism: &scene.mechanism };
        let asked = scene.mechanism.asked.iter().zip(&solved.solution.construction.answers);
        asked.map(|(a, r)| ratio(&reading.read(a.quantity), &r.answer)).fold(0.0, f64::max)
    };
    assert!(worst(&svg) <= 1.0);
    let scaled = svg.replace("50\u{a0}cm/s\u{a0}≡", "49\u{a0}cm/s\u{a0}≡");
    assert!(scaled != svg && worst(&scaled) > 1e3, "{}", worst(&scaled));
    // The tip of v(B): the head's first corner.
    let at = svg.find("data-quantity=\"v(B)\"").unwrap();
    let head = at + svg[at..].find("class=\"head\" d=\"M").unwrap() + "class=\"head\" d=\"M".len();
    let end = head + svg[head..].find(' ').unwrap();
    let x: f64 = svg[head..end].parse().unwrap();
    let moved = format!("{}{:.6}{}", &svg[..head], x + 0.01, &svg[end..]);
    assert!(worst(&moved) > 1e3, "{}", worst(&moved));
}
