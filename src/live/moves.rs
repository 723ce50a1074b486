//! How the ink of a diagram moves with the numbers of the program.
//!
//! The sheet draws the same diagram at some positions of the course. What keeps its place there in a frame of two points,
//! or beside one, is bound to them; what keeps it in no frame is shown at the scene's own position only. So nothing here
//! knows what a stroke stands for, and a symbol that the sheet learns to draw needs nothing here.

use kurbo::{Point, Vec2};
use serde_json::{Value, json};

use crate::sheet::figure::{Group, Mark, Node, Shape};

/// A point of a diagram, by the outputs that tell where it is.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Place {
    /// Signs and the outputs of the x-coordinates; the y-coordinate is the output after each. Nothing: the origin.
    pub(super) terms: Vec<(i8, usize)>,
}

/// One position of a diagram.
#[derive(Debug, Clone)]
pub(super) struct Seen {
    /// Where its places are on the page; nothing where one is not known now, or lies at infinity.
    pub(super) places: Vec<Option<Point>>,
    /// The numbers of the position, by output.
    pub(super) numbers: Vec<Option<f64>>,
}

impl Seen {
    pub(super) fn at(&self, place: usize) -> Option<Point> {
        self.places.get(place).copied().flatten()
    }

    fn number(&self, output: usize) -> Option<f64> {
        self.numbers.get(output).copied().flatten()
    }
}

/// What ink keeps its place in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Frame {
    /// The page.
    Fixed,
    /// Shifted with a place.
    At(usize),
    /// At the first place, turned with the direction to the second.
    Rigid(usize, usize),
    /// The same, and stretched with their distance.
    Similar(usize, usize),
    /// At a place, turned to an angle that is an output.
    Headed(usize, usize),
    /// At a place, turned and stretched with the vector whose coordinates are this output and the one after it.
    Carried(usize, usize),
    /// The same with the second vector, at a point that keeps its place as the first one carries it from the place.
    Summed(usize, usize, [f64; 2], usize),
}

/// Places nearer to each other tell no direction, mm.
const NEAR: f64 = 0.05;
/// Shorter vectors tell no direction, in their SI units.
const SMALL: f64 = 1e-9;
/// What strays by less keeps its place, mm.
const STRAY: f64 = 2e-5;

impl Frame {
    /// Its origin and x-axis; none where its places fall together.
    fn axes(self, seen: &Seen) -> Option<(Point, Vec2)> {
        match self {
            Self::Fixed => Some((Point::ORIGIN, Vec2::new(1.0, 0.0))),
            Self::At(a) => Some((seen.at(a)?, Vec2::new(1.0, 0.0))),
            Self::Headed(a, output) => {
                let (sin, cos) = libm::sincos(seen.number(output)?);
                Some((seen.at(a)?, Vec2::new(cos, -sin)))
            }
            Self::Carried(a, output) => {
                let along = Vec2::new(seen.number(output)?, -seen.number(output + 1)?);
                (along.hypot() > SMALL && along.is_finite()).then_some((seen.at(a)?, along))
            }
            Self::Summed(a, first, [x, y], second) => {
                let origin = Self::Carried(a, first).global(Vec2::new(x, y), seen)?;
                Some((origin, Self::Carried(a, second).axes(seen)?.1))
            }
            Self::Rigid(a, b) | Self::Similar(a, b) => {
                let (a, b) = (seen.at(a)?, seen.at(b)?);
                let along = b - a;
                if along.hypot() < NEAR {
                    return None;
                }
                Some((a, if matches!(self, Self::Rigid(..)) { along.normalize() } else { along }))
            }
        }
    }

    pub(super) fn local(self, at: Point, seen: &Seen) -> Option<Vec2> {
        let (origin, x) = self.axes(seen)?;
        let d = at - origin;
        Some(Vec2::new(d.dot(x), x.cross(d)) / x.hypot2())
    }

    pub(super) fn global(self, own: Vec2, seen: &Seen) -> Option<Point> {
        let (origin, x) = self.axes(seen)?;
        Some(origin + x * own.x + Vec2::new(-x.y, x.x) * own.y)
    }

    /// How far a unit of its own coordinates is on the page.
    fn size(self, seen: &Seen) -> f64 {
        self.axes(seen).map_or(1.0, |(_, x)| x.hypot())
    }

    pub(super) fn json(self) -> Value {
        match self {
            Self::Fixed => json!([0]),
            Self::At(a) => json!([1, a]),
            Self::Rigid(a, b) => json!([2, a, b]),
            Self::Similar(a, b) => json!([3, a, b]),
            Self::Headed(a, output) => json!([4, a, output]),
            Self::Carried(a, output) => json!([5, a, output]),
            Self::Summed(a, first, [x, y], second) => json!([6, a, first, x, y, second]),
        }
    }
}

/// Several positions of one diagram.
#[derive(Debug, Clone)]
pub(super) struct Binder {
    /// The places in each position; the scene's own is the first.
    pub(super) seen: Vec<Seen>,
    /// Outputs that are angles of links.
    pub(super) angles: Vec<usize>,
    /// Outputs that are the first coordinate of a vector that moves.
    pub(super) vectors: Vec<usize>,
}

impl Binder {
    /// The frame in which points keep their place, each told in every position; the simplest that there is.
    pub(super) fn frame(&self, points: &[Vec<Point>]) -> Option<Frame> {
        let count = self.seen.first()?.places.len();
        if self.seen.len() < 3 || points.is_empty() {
            return None;
        }
        let singles = (0..count).map(Frame::At);
        let pairs = || (0..count).flat_map(|a| (0..count).filter(move |b| *b != a).map(move |b| (a, b)));
        std::iter::once(Frame::Fixed)
            .chain(singles)
            .chain(pairs().map(|(a, b)| Frame::Rigid(a, b)))
            .chain((0..count).flat_map(|a| self.angles.iter().map(move |angle| Frame::Headed(a, *angle))))
            .chain(pairs().map(|(a, b)| Frame::Similar(a, b)))
            .chain((0..count).flat_map(|a| self.vectors.iter().map(move |vector| Frame::Carried(a, *vector))))
            .find(|frame| points.iter().all(|point| self.keeps(*frame, point)))
    }

    fn keeps(&self, frame: Frame, point: &[Point]) -> bool {
        let Some((first, rest)) = self.seen.split_first() else { return false };
        let Some(own) = point.first().and_then(|at| frame.local(*at, first)) else { return false };
        point.len() == self.seen.len()
            && rest.iter().zip(&point[1..]).all(|(seen, at)| {
                let stray = frame.local(*at, seen).map(|now| (now - own).hypot() * frame.size(seen));
                stray.is_some_and(|stray| stray <= STRAY)
            })
    }

    pub(super) fn local(&self, frame: Frame, at: Point) -> Option<Vec2> {
        frame.local(at, self.seen.first()?)
    }

    /// A point that is told in every position, in the frame in which it keeps its place.
    pub(super) fn bound(&self, points: &[Point]) -> Option<(Frame, Vec2)> {
        let frame = self.frame(&[points.to_vec()]).or_else(|| self.summed(points))?;
        Some((frame, self.local(frame, *points.first()?)?))
    }

    /// The frame of a point that two vectors lead to from a place, each turned and stretched always alike: two positions tell by how
    /// much, the others whether it is so.
    fn summed(&self, points: &[Point]) -> Option<Frame> {
        if self.seen.len() < 4 || points.len() != self.seen.len() {
            return None;
        }
        let vector =
            |output: usize, seen: &Seen| Frame::Carried(0, output).axes(seen).map(|(_, along)| along);
        let times = |a: Vec2, b: Vec2| Vec2::new(a.x * b.x - a.y * b.y, a.x * b.y + a.y * b.x);
        let [(one, here), (other, there)] = [0, 1].map(|index: usize| (&self.seen[index], points[index]));
        let of = |place: usize, first: usize, second: usize| {
            let ways = (here - one.at(place)?, there - other.at(place)?);
            let [p, q] = [first, second].map(|output| Some((vector(output, one)?, vector(output, other)?)));
            let (p, q) = (p?, q?);
            // Of complex numbers, as a turn with a stretch is one.
            let crossed = times(p.0, q.1) - times(p.1, q.0);
            if crossed.hypot() < 1e-6 * p.0.hypot() * q.1.hypot() {
                return None;
            }
            let part = times(ways.0, q.1) - times(ways.1, q.0);
            let part = times(part, Vec2::new(crossed.x, -crossed.y)) / crossed.hypot2();
            let frame = Frame::Summed(place, first, [part.x, part.y], second);
            self.keeps(frame, points).then_some(frame)
        };
        let places = 0..one.places.len();
        let pairs = self.vectors.iter().flat_map(|a| self.vectors.iter().map(move |b| (*a, *b)));
        places
            .flat_map(|place| pairs.clone().map(move |pair| (place, pair)))
            .find_map(|(place, (first, second))| of(place, first, second))
    }

    /// A length that is told in every position, as a part of the unit of a frame.
    pub(super) fn part_of(&self, lengths: &[f64]) -> Option<(Frame, f64)> {
        let count = self.seen.first()?.places.len();
        let pairs = (0..count).flat_map(|a| (0..a).map(move |b| Frame::Similar(a, b)));
        let vectors =
            self.vectors.iter().flat_map(|vector| (0..count.min(1)).map(|a| Frame::Carried(a, *vector)));
        std::iter::once(Frame::Fixed).chain(pairs).chain(vectors).find_map(|frame| {
            let sizes = self.seen.iter().map(|seen| Some(frame.axes(seen)?.1.hypot()));
            let parts: Option<Vec<f64>> =
                sizes.zip(lengths).map(|(size, length)| Some(length / size?)).collect();
            let (parts, size) = (parts?, frame.size(self.seen.first()?));
            let first = *parts.first()?;
            let same = parts.len() >= 3 && parts.iter().all(|part| (part - first).abs() * size <= STRAY);
            same.then_some((frame, first))
        })
    }
}

/// How a group of ink moves.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Move {
    /// It is moved as a whole.
    Whole(Frame),
    /// Its strokes go from point to point, each in a frame of its own: by stroke, whether it is closed and its points.
    Strokes(Vec<(bool, Vec<(Frame, Vec2)>)>),
    /// A vector from place to place.
    Vector([usize; 2]),
    /// A line from a place through another one and a little past it.
    Ray([usize; 2]),
    /// A closed outline through places.
    Outline(Vec<usize>),
    /// An arc with an arrow about a place, from the right to the angle that is varied, or to that which is an output.
    Turn(usize, f64, Option<usize>),
    /// A line through all of these points that are known, and so far past the outermost, mm; as far as it is on the panel.
    Through(Vec<(Frame, Vec2)>, f64),
    /// An arrow from point to point.
    Arrow([(Frame, Vec2); 2]),
    /// A circle about a point, its radius a part of the unit of a frame.
    Round((Frame, Vec2), (Frame, f64)),
    /// A mark about a point of a frame, upright.
    Mark((Frame, Vec2)),
    /// Seen at the scene's own position only.
    Still,
}

/// A line past the point that it helped to find, mm.
pub(super) const PAST: f64 = 4.0;

/// Ink that moves.
#[derive(Debug, Clone)]
pub(super) struct Moving {
    /// The identifier of its group.
    pub(super) id: String,
    /// How.
    pub(super) by: Move,
    /// A quantity that it shows, by its name in the data.
    pub(super) quantity: Option<String>,
    /// Shown while the output of this index has this sign.
    pub(super) sense: Option<(usize, bool)>,
    /// The step that draws it.
    pub(super) step: Option<usize>,
    /// Its ink at the scene's own position.
    pub(super) ink: Group,
}

impl Moving {
    pub(super) fn json(&self, panel: usize) -> Value {
        let mut all = json!({ "panel": panel, "id": self.id });
        let point = |(frame, own): &(Frame, Vec2)| json!([frame.json(), [own.x, own.y]]);
        let (kind, at) = match &self.by {
            Move::Whole(Frame::Fixed) => ("fixed", json!([])),
            Move::Whole(frame) => ("whole", frame.json()),
            Move::Strokes(strokes) => {
                let stroke = |(closed, points): &(bool, Vec<(Frame, Vec2)>)| {
                    json!([closed, points.iter().map(point).collect::<Vec<_>>()])
                };
                ("strokes", json!(strokes.iter().map(stroke).collect::<Vec<_>>()))
            }
            Move::Vector(ends) => ("vector", json!(ends)),
            Move::Ray(ends) => ("ray", json!(ends)),
            Move::Outline(through) => ("outline", json!(through)),
            Move::Turn(place, radius, None) => ("turn", json!([place, radius])),
            Move::Turn(place, radius, Some(angle)) => ("turn", json!([place, radius, angle])),
            Move::Through(points, _) => ("through", json!(points.iter().map(point).collect::<Vec<_>>())),
            Move::Arrow(ends) => ("arrow", json!(ends.iter().map(point).collect::<Vec<_>>())),
            Move::Round(centre, (frame, part)) => ("round", json!([point(centre), frame.json(), part])),
            Move::Mark(at) => ("mark", point(at)),
            Move::Still => ("still", json!([])),
        };
        all["move"] = json!(kind);
        all["at"] = at;
        if let Move::Through(_, past) = self.by
            && past != PAST
        {
            all["past"] = json!(past);
        }
        if let Some(quantity) = &self.quantity {
            all["quantity"] = json!(quantity);
        }
        if let Some((output, positive)) = self.sense {
            all["sense"] = json!([output, positive]);
        }
        if let Some(step) = self.step {
            all["step"] = json!(step);
        }
        all
    }

    /// The same ink in another position, as far as labels must keep clear of it.
    pub(super) fn moved(&self, start: &Seen, now: &Seen) -> Option<Group> {
        let mut group = Group::new("moved");
        match &self.by {
            Move::Still => return None,
            Move::Whole(frame) => {
                let shift = |at: Point| frame.local(at, start).and_then(|own| frame.global(own, now));
                let mut moved = Some(());
                self.ink.walk(&mut |node| {
                    if let Node::Mark(mark) = node {
                        match shape_through(&mark.shape, shift) {
                            Some(shape) => group.mark(Mark { shape, ..mark.clone() }),
                            None => moved = None,
                        }
                    }
                });
                moved?;
            }
            Move::Strokes(strokes) => {
                let mut all = Vec::new();
                self.ink.walk(&mut |node| {
                    if let Node::Mark(mark) = node {
                        all.push(mark.clone());
                    }
                });
                for (mark, (closed, points)) in all.into_iter().zip(strokes) {
                    let through: Option<Vec<Point>> =
                        points.iter().map(|(frame, own)| frame.global(*own, now)).collect();
                    let through = through?;
                    let shape = if *closed { Shape::Polygon(through) } else { Shape::Polyline(through) };
                    group.mark(Mark { shape, ..mark });
                }
            }
            Move::Vector([a, b]) | Move::Ray([a, b]) => {
                let (from, mut to) = (now.at(*a)?, now.at(*b)?);
                if matches!(self.by, Move::Ray(_)) {
                    to += (to - from) * (PAST / (to - from).hypot().max(1e-9));
                }
                let pen = crate::sheet::figure::Pen::solid(0.3);
                group.mark(Mark::stroke(Shape::Line(from, to), pen));
            }
            Move::Through(points, _) => {
                let known: Vec<Point> = points.iter().filter_map(|(f, own)| f.global(*own, now)).collect();
                let far = |at: &&Point| at.to_vec2().hypot() < 1e4;
                let (from, to) = (known.first().filter(far)?, known.last().filter(far)?);
                group.mark(Mark::stroke(Shape::Line(*from, *to), crate::sheet::figure::Pen::solid(0.2)));
            }
            Move::Arrow([from, to]) => {
                let (from, to) = (from.0.global(from.1, now)?, to.0.global(to.1, now)?);
                group.mark(Mark::stroke(Shape::Line(from, to), crate::sheet::figure::Pen::solid(0.3)));
            }
            Move::Round(centre, (frame, part)) => {
                let (centre, radius) = (centre.0.global(centre.1, now)?, part * frame.size(now));
                let circle = Shape::Circle { centre, radius };
                group.mark(Mark::stroke(circle, crate::sheet::figure::Pen::solid(0.2)));
            }
            Move::Outline(_) | Move::Turn(..) | Move::Mark(_) => return None,
        }
        Some(group)
    }
}

pub(super) fn shape_through(shape: &Shape, shift: impl Fn(Point) -> Option<Point>) -> Option<Shape> {
    let all = |points: &[Point]| points.iter().map(|at| shift(*at)).collect::<Option<Vec<_>>>();
    Some(match shape {
        Shape::Line(a, b) => Shape::Line(shift(*a)?, shift(*b)?),
        Shape::Polyline(points) => Shape::Polyline(all(points)?),
        Shape::Polygon(points) => Shape::Polygon(all(points)?),
        Shape::Circle { centre, radius } => Shape::Circle { centre: shift(*centre)?, radius: *radius },
        Shape::Arc { .. } | Shape::Curve(_) => {
            let mut through = Vec::new();
            for (a, b) in shape.outline() {
                if through.is_empty() {
                    through.push(shift(a)?);
                }
                through.push(shift(b)?);
            }
            Shape::Polyline(through)
        }
    })
}

/// Ink that hangs on what it lies in and is drawn anew for every position: hatching, the bridge over a joint.
fn rides_along(mark: &Mark) -> bool {
    matches!(mark.class, "hatch" | "continuity")
}

/// The points that tell where a mark is, and what of it may not change.
fn told(mark: &Mark) -> (Vec<Point>, [f64; 2]) {
    use crate::sheet::figure::on_circle;
    match &mark.shape {
        Shape::Line(a, b) => (vec![*a, *b], [0.0; 2]),
        Shape::Polyline(points) | Shape::Polygon(points) => (points.clone(), [0.0; 2]),
        Shape::Circle { centre, radius } => (vec![*centre], [*radius, 0.0]),
        Shape::Arc { centre, radius, start, sweep } => {
            let ends = [*start, start + sweep].map(|angle| on_circle(*centre, *radius, angle));
            (vec![*centre, ends[0], ends[1]], [*radius, *sweep])
        }
        Shape::Curve(path) => {
            let points = path.elements().iter().filter_map(kurbo::PathEl::end_point).collect();
            (points, [0.0; 2])
        }
    }
}

/// The marks of a group, in order.
pub(super) fn marks(group: &Group) -> Vec<&Mark> {
    let mut all = Vec::new();
    group.walk(&mut |node| {
        if let Node::Mark(mark) = node {
            all.push(mark);
        }
    });
    all
}

/// How one piece of ink moves that was drawn in several positions.
pub(super) fn bind(binder: &Binder, drawn: &[&Group]) -> Move {
    let (Some(first), true) = (drawn.first(), drawn.len() == binder.seen.len()) else { return Move::Still };
    let own = |group: &Group| -> Vec<Mark> {
        marks(group).into_iter().filter(|mark| !rides_along(mark)).cloned().collect()
    };
    let all: Vec<Vec<Mark>> = drawn.iter().map(|group| own(group)).collect();
    let riding = marks(first).len() > all[0].len();
    if all[0].is_empty() || all.iter().any(|marks| marks.len() != all[0].len()) {
        return Move::Still;
    }
    // By mark and point, in every position.
    let mut points: Vec<Vec<Vec<Point>>> = Vec::new();
    let mut rigid = true;
    for index in 0..all[0].len() {
        let told: Vec<(Vec<Point>, [f64; 2])> = all.iter().map(|marks| told(&marks[index])).collect();
        let (count, sizes) = (told[0].0.len(), told[0].1);
        if told.iter().any(|(points, _)| points.len() != count) {
            return Move::Still;
        }
        let same =
            |now: &[f64; 2]| now.iter().zip(&sizes).all(|(a, b)| (a - b).abs() <= 1e-6 * (1.0 + b.abs()));
        rigid &= told.iter().all(|(_, now)| same(now));
        points.push((0..count).map(|i| told.iter().map(|(points, _)| points[i]).collect()).collect());
    }
    let together: Vec<Vec<Point>> = points.iter().flatten().cloned().collect();
    if let (true, Some(frame)) = (rigid, binder.frame(&together)) {
        let round = all[0].iter().any(|m| matches!(m.shape, Shape::Circle { .. } | Shape::Arc { .. }));
        if !(round && matches!(frame, Frame::Similar(..))) {
            return Move::Whole(frame);
        }
    }
    let straight = |m: &Mark| matches!(m.shape, Shape::Line(..) | Shape::Polyline(_) | Shape::Polygon(_));
    if riding || !all[0].iter().all(straight) {
        return Move::Still;
    }
    let mut strokes = Vec::new();
    for (mark, points) in all[0].iter().zip(&points) {
        let mut stroke = Vec::new();
        for point in points {
            let own = |frame: Frame| Some((frame, binder.local(frame, point[0])?));
            match binder.frame(std::slice::from_ref(point)).and_then(own) {
                Some(bound) => stroke.push(bound),
                None => return Move::Still,
            }
        }
        strokes.push((matches!(mark.shape, Shape::Polygon(_)), stroke));
    }
    Move::Strokes(strokes)
}
