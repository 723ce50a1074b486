//! Dimension lines on the skeleton of a question: the stated lengths, the places of fixed points and guides,
//! the radii of wheels, the angles of bell cranks.

use kurbo::{Point, Rect, Vec2};

use super::figure::{Group, Mark, Pen, Shape, on_circle};
use super::given;
use super::human;
use super::ink::{FINE, HEAD, SMALL, arc_arrow, head};
use super::labels::{Obstacles, Request, Site};
use super::rich::Rich;
use super::skeleton::{Artist, PIN};
use crate::mechanism::{Direction, Form, GuidePoint, LinkId, Path, PointId, Roll};

/// How far dimension lines stand from what they measure.
const AWAY: [f64; 9] = [7.5, 10.0, 12.5, 15.0, 18.0, 21.0, 24.5, 28.0, 33.0];
/// How far an extension line runs past the dimension line.
const PAST: f64 = 1.3;
/// Shorter dimensions have their arrowheads outside.
const TIGHT: f64 = 3.2 * HEAD;
/// Distances shorter than this on paper are not dimensioned.
pub(super) const SHORTEST: f64 = 1.5;
/// Size of a dimension's text beside that of other labels.
pub(super) const TYPE: f64 = 0.95 * SMALL;

/// Dimension lines that disturb more than this are left out; the given data name every dimension in words.
const WORST: f64 = 75.0;

/// The class of a dimension's text.
pub(super) const CLASS: &str = "label dimension";

/// A dimension as it is drawn.
pub(super) struct Drawn {
    /// How much it disturbs.
    pub cost: f64,
    /// Its lines.
    pub ink: Group,
    /// Its text; none of a mark.
    pub text: Option<Request>,
    /// The point whose place it gives along an axis, 0 level, 1 upright.
    pub places: Option<(PointId, usize)>,
}

/// A distance to be dimensioned.
pub(super) struct Distance {
    from: Point,
    to: Point,
    /// A unit vector.
    along: Vec2,
    text: Rich,
    places: Option<(PointId, usize)>,
}

impl Distance {
    /// Of two places along a direction.
    pub(super) fn new(from: Point, to: Point, along: Vec2, text: Rich) -> Self {
        Self { from, to, along, text, places: None }
    }
}

/// A dimension line's place: both ends, and the points that they measure.
#[derive(Debug, Clone, Copy)]
struct Span {
    measured: [Point; 2],
    ends: [Point; 2],
    /// Away from what is measured.
    away: Vec2,
}

impl Artist<'_> {
    /// All dimensions that find room.
    pub(super) fn dimensions(&self, group: &Group) -> Vec<Drawn> {
        let mut all = Vec::new();
        let mut ink = Obstacles::of(group);
        let lengths = self.link_lengths();
        let places = self.frame_lengths();
        for distance in lengths.into_iter().chain(places) {
            self.length(&mut all, &mut ink, distance);
        }
        self.wheel_radii(&mut all, &mut ink);
        self.bell_cranks(&mut all);
        self.shapes(&mut all, &mut ink);
        self.loci(&mut all, &mut ink);
        self.guides(&mut all, &mut ink);
        all
    }

    pub(super) fn stated(&self, metres: f64) -> Rich {
        given::stated_length(metres, &self.notation)
    }

    /// The stated lengths of links and the distances by which places are stated, each along its own line.
    fn link_lengths(&self) -> Vec<Distance> {
        let mechanism = self.notation.mechanism();
        let mut dimensions: Vec<given::StatedLength> =
            mechanism.moving().flat_map(|l| given::dimensions(mechanism.link(l), &self.notation)).collect();
        for own in given::stated_distances(&self.notation) {
            if !dimensions.iter().any(|other| other.is_between([own.from, own.to])) {
                dimensions.push(own);
            }
        }
        let drawn = dimensions.into_iter().filter_map(|d| {
            let (a, b) = (self.pose.place(d.from)?, self.pose.place(d.to)?);
            (a.distance(b) > SHORTEST).then(|| Distance {
                from: a,
                to: b,
                along: (b - a).normalize(),
                text: self.stated(d.length),
                places: None,
            })
        });
        drawn.collect()
    }

    /// Places of given points and fixed guides, level and upright, from the first fixed point.
    fn frame_lengths(&self) -> Vec<Distance> {
        let mechanism = self.notation.mechanism();
        let exact = |p: PointId| mechanism.points.get(p.0)?.place.exact().map(|at| at.map(|c| c.value));
        let mut given = (0..mechanism.points.len()).map(PointId);
        let Some(first) = given.clone().find(|p| mechanism.is_fixed(*p)) else { return Vec::new() };
        let (Some(origin), Some(start)) = (exact(first), self.pose.place(first)) else { return Vec::new() };
        // Each with its length, positive to the right and up, and whether it is of a place that moves.
        let mut all: Vec<(bool, f64, Distance)> = Vec::new();
        let level = Vec2::new(1.0, 0.0);
        let upright = Vec2::new(0.0, 1.0);
        // Those of the frame come first: they find room before the others.
        for point in given.by_ref().filter(|p| *p != first && !self.far.contains(p)) {
            let (Some(place), Some(at)) = (exact(point), self.pose.place(point)) else { continue };
            for (axis, along) in [(0, level), (1, upright)] {
                let length = place[axis] - origin[axis];
                if self.pose.paper(length.abs()) > SHORTEST {
                    let text = self.stated(length.abs());
                    let own = Distance { from: start, to: at, along, text, places: Some((point, axis)) };
                    all.push((!mechanism.is_fixed(point), length, own));
                }
            }
        }
        let guides = mechanism.slides.iter().map(|slide| (slide.guide, self.pose.rider(slide)));
        let rails =
            mechanism.rolls.iter().zip(&mechanism.contacts).filter_map(|(roll, contact)| match roll {
                Roll::Line { guide, .. } => Some((*guide, self.pose.place(*contact))),
                Roll::Circles { .. } => None,
            });
        for (guide, rider) in guides.chain(rails).filter(|(guide, _)| guide.link == LinkId::FRAME) {
            let Path::Straight { through, direction: Direction::Angle(angle), turned, offset } = guide.path
            else {
                continue;
            };
            let (sin, cos) = libm::sincos(angle.value + turned.value);
            // Level and upright guides have a distance that the statement gives; others are told in words.
            let axis = if sin == 0.0 {
                1
            } else if cos.abs() < 1e-15 {
                0
            } else {
                continue;
            };
            let base = match through {
                GuidePoint::Own(at) => Some(at.map(|c| c.value)),
                GuidePoint::Point(p) => exact(p),
            };
            let (Some(base), Some(rider)) = (base, rider) else { continue };
            let left = if axis == 1 { cos * offset.value } else { -sin * offset.value };
            let length = base[axis] + left - origin[axis];
            let along = if axis == 0 { level } else { upright };
            // A point of the guide may have the dimension already.
            let same = |(_, other, own): &(bool, f64, Distance)| {
                own.along == along && (other - length).abs() <= 1e-9 * length.abs()
            };
            if self.pose.paper(length.abs()) > SHORTEST && !all.iter().any(same) {
                let text = self.stated(length.abs());
                all.push((false, length, Distance { from: start, to: rider, along, text, places: None }));
            }
        }
        // The shorter ones stand nearer, so that no line crosses the extension of another.
        all.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.abs().total_cmp(&b.1.abs())));
        all.into_iter().map(|(.., distance)| distance).collect()
    }

    /// One dimension line where it disturbs least.
    pub(super) fn length(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles, distance: Distance) {
        let Distance { from: a, to: b, along, text, places } = distance;
        let line = text.set(TYPE);
        let room = (line.ink.width() + 1.2, line.ink.height() + 1.2);
        let across = Vec2::new(-along.y, along.x);
        let mut best: Option<(f64, Span)> = None;
        for away in [across, -across] {
            let level = a.to_vec2().dot(away).max(b.to_vec2().dot(away));
            for (rank, off) in AWAY.into_iter().enumerate() {
                let end = |p: Point| p + away * (level + off - p.to_vec2().dot(away));
                let span = Span { measured: [a, b], ends: [end(a), end(b)], away };
                // Upward and to the right is where one looks first.
                let taste = 1.2 * rank as f64 + if away.y > 0.0 || away.x < 0.0 { 0.6 } else { 0.0 };
                let cost = taste + self.disturbance(ink, span, room);
                if best.is_none_or(|(least, _)| cost < least) {
                    best = Some((cost, span));
                }
            }
        }
        let Some((cost, span)) = best.filter(|(cost, _)| *cost < WORST) else { return };
        let own = drawn(span);
        ink.extend(&own);
        let [from, to] = span.ends;
        let mut request = Request::new(text, TYPE, Site::Along { from, to }, CLASS);
        request.leader = true;
        all.push(Drawn { cost, ink: own, text: Some(request), places });
    }

    /// The points whose places these dimensions give whole: along both axes, but where they lie level with the first fixed
    /// point, or upright over it.
    pub(super) fn dimensioned(&self, drawn: &[Drawn]) -> Vec<PointId> {
        let mechanism = self.notation.mechanism();
        let exact = |p: PointId| mechanism.points.get(p.0)?.place.exact().map(|at| at.map(|c| c.value));
        let all = (0..mechanism.points.len()).map(PointId);
        let Some(origin) = all.clone().find(|p| mechanism.is_fixed(*p)).and_then(exact) else {
            return Vec::new();
        };
        let has = |point, axis| drawn.iter().any(|d| d.places == Some((point, axis)));
        let whole = |p: &PointId| {
            exact(*p).is_some_and(|at| (0..2).all(|axis| at[axis] == origin[axis] || has(*p, axis)))
        };
        // Dimensions are from the first fixed point: it is told where it is not the origin.
        all.filter(|_| origin == [0.0; 2]).filter(whole).collect()
    }

    fn disturbance(&self, ink: &Obstacles, span: Span, room: (f64, f64)) -> f64 {
        let [a, b] = span.ends;
        let mut cost = walk(a, b, 2.0).map(|p| touched(ink, p)).sum::<f64>();
        for (measured, end) in span.measured.into_iter().zip(span.ends) {
            let d = end - measured;
            let free = measured + d * ((PIN + 1.5) / d.hypot().max(PIN + 1.5));
            cost += 0.4 * walk(free, end, 2.0).map(|p| touched(ink, p)).sum::<f64>();
        }
        let reach = (span.away.x * room.0).abs() / 2.0 + (span.away.y * room.1).abs() / 2.0 + 0.6;
        let beside = |side: f64| {
            let own = Rect::from_center_size(a.midpoint(b) + span.away * (side * reach), room);
            ink.cost_up_to(own, 80.0).min(80.0)
        };
        cost + beside(1.0).min(beside(-1.0))
    }

    /// The radii of pitch circles: an arrow from the centre to the circle.
    fn wheel_radii(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles) {
        let mut wheels: Vec<(PointId, f64, Option<u32>)> = Vec::new();
        for (index, roll) in self.notation.mechanism().rolls.iter().enumerate() {
            let gears = self.notation.scene.gears.get(index).and_then(Option::as_ref);
            let teeth = |wheel: usize| gears.and_then(|gears| gears.teeth.get(wheel).copied());
            let own = match roll {
                Roll::Circles { centres, radii, .. } => {
                    [0, 1].map(|i| (centres[i], radii[i].value, teeth(i))).to_vec()
                }
                Roll::Line { centre, radius, .. } => vec![(*centre, radius.value, teeth(0))],
            };
            // A wheel between two others rolls on both, and has one radius.
            let has = |all: &[(PointId, f64, Option<u32>)], own: &(PointId, f64, Option<u32>)| {
                all.iter().any(|other| other.0 == own.0 && other.1 == own.1)
            };
            for wheel in own {
                if !has(&wheels, &wheel) {
                    wheels.push(wheel);
                }
            }
        }
        for (centre, radius, teeth) in wheels {
            let Some(at) = self.pose.place(centre) else { continue };
            let drawn = self.pose.paper(radius);
            if drawn < 2.0 * SHORTEST + HEAD {
                continue;
            }
            let ways = (0..24).map(|k| f64::from(k) * (std::f64::consts::TAU / 24.0));
            let cost = |way: f64| {
                let (from, to) = (on_circle(at, PIN + 1.0, way), on_circle(at, drawn - 1.0, way));
                walk(from, to, 2.0).map(|p| touched(ink, p)).sum::<f64>()
            };
            let best = ways.map(|way| (cost(way), way)).reduce(|a, b| if b.0 < a.0 { b } else { a });
            let Some((cost, way)) = best else { continue };
            let (from, tip) = (on_circle(at, PIN, way), on_circle(at, drawn, way));
            let mut own = Group::new("dimension radius");
            own.mark(Mark::stroke(Shape::Line(from, tip), Pen::solid(FINE)).class("dimension-line"));
            own.mark(head(tip, (tip - from).normalize(), HEAD * 0.8));
            ink.extend(&own);
            let text = Rich::italic("R").up("\u{2009}").then(&self.stated(radius));
            all.extend(teeth.map(|teeth| wheel_teeth(at, drawn, teeth)));
            let mut request = Request::new(text, TYPE, Site::Along { from, to: tip }, CLASS);
            request.leader = true;
            all.push(Drawn { cost, ink: own, text: Some(request), places: None });
        }
    }

    /// The angles between the arms of bell cranks.
    fn bell_cranks(&self, all: &mut Vec<Drawn>) {
        for link in self.notation.mechanism().moving() {
            let Form::Arms { angle, .. } = &self.notation.mechanism().link(link).form else { continue };
            let [(_, vertex), (_, one), (_, other)] = self.pose.places(link)[..] else { continue };
            let radius = (0.6 * one.distance(vertex).min(other.distance(vertex))).clamp(5.0, 9.0);
            let d = one - vertex;
            let start = libm::atan2(-d.y, d.x);
            let mut own = Group::new("dimension angle");
            arc_arrow(&mut own, vertex, radius, start, angle.value, FINE);
            let at = on_circle(vertex, radius, start + angle.value / 2.0);
            let toward = Some(start + angle.value / 2.0);
            let text = human::degrees(angle.value.abs());
            let mut request = Request::new(text, TYPE, Site::Around { at, radius: 0.3, toward }, CLASS);
            request.leader = true;
            all.push(Drawn { cost: 0.0, ink: own, text: Some(request), places: None });
        }
    }
}

/// The number of teeth of a wheel, outside of its pitch circle.
fn wheel_teeth(at: Point, radius: f64, teeth: u32) -> Drawn {
    let text = Rich::italic("z").up(&format!("\u{a0}=\u{a0}{teeth}"));
    let site = |k: u32| {
        let way = f64::from(k) * (std::f64::consts::TAU / 12.0);
        Site::Around { at: on_circle(at, radius, way), radius: 0.5, toward: Some(way) }
    };
    let first = Request::new(text, TYPE, site(1), CLASS);
    let request = (2..=12).fold(first, |request, k| request.or(site(k)));
    Drawn { cost: 0.0, ink: Group::new("dimension"), text: Some(request), places: None }
}

/// A dimension line with its arrowheads and extension lines.
fn drawn(span: Span) -> Group {
    let mut own = Group::new("dimension");
    let [a, b] = span.ends;
    for (measured, end) in span.measured.into_iter().zip(span.ends) {
        let d = end - measured;
        if d.hypot() > PIN + 1.0 {
            let from = measured + d.normalize() * (PIN + 0.8);
            let line = Shape::Line(from, end + span.away * PAST);
            own.mark(Mark::stroke(line, Pen::solid(FINE)).class("extension-line"));
        }
    }
    let along = (b - a).normalize();
    let (outward, from, to) = if a.distance(b) < TIGHT {
        (false, a - along * (1.8 * HEAD), b + along * (1.8 * HEAD))
    } else {
        (true, a, b)
    };
    own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("dimension-line"));
    let sign = if outward { 1.0 } else { -1.0 };
    own.mark(head(a, along * -sign, HEAD * 0.8));
    own.mark(head(b, along * sign, HEAD * 0.8));
    own
}

/// Places along a stroke.
pub(super) fn walk(a: Point, b: Point, step: f64) -> impl Iterator<Item = Point> {
    let pieces = (a.distance(b) / step).ceil().clamp(1.0, 400.0);
    (0..=pieces as usize).map(move |i| a.lerp(b, i as f64 / pieces))
}

pub(super) fn touched(ink: &Obstacles, at: Point) -> f64 {
    ink.cost_up_to(Rect::from_center_size(at, (1.0, 1.0)), 6.0).min(6.0)
}
