//! Curves of a sweep as Béziers, fitted within a tolerance (kurbo; R. Levien, *Parallel curves of cubic
//! Béziers*, 2022).
//!
//! A stretch is looked at once, at as many places as it takes for a cubic between two of them to be as good as a look;
//! whatever is drawn of it afterwards, and however often, is read off that table.

use std::cell::RefCell;
use std::f64::consts::{PI, TAU};
use std::ops::Range;

use kurbo::{BezPath, CurveFitSample, ParamCurveFit, PathSeg, Point, Vec2, fit_to_bezpath};

use super::{Node, Stretch, Sweep, course, ranges};
use crate::board::{Dual, Workspace};
use crate::mechanism::quantity::Quantity;

/// A point of the page and how it moves with the input; `None` where the numbers have none.
pub type Track<'t> = dyn Fn(f64, &[Option<Dual>]) -> Option<(Point, Vec2)> + 't;

/// A whole turn is first looked at in so many places.
const PLACES: f64 = 180.0;
/// A cubic between two places strays from the truth by no more than this part of a column's range.
const STRAY: f64 = 1e-6;
/// An interval is halved so often at most: what jumps is left at that.
const MOST_HALVINGS: u32 = 10;
/// A table of a whole turn has no more places.
const MOST_PLACES: usize = 6_000;
/// The very ends have no finite derivative at a limit.
const END: f64 = 1e-6;

/// A stretch in the parameter t from 0 to 1, in which the input runs as a cosine, slowly near both ends: at a limit
/// everything goes as the root of what is left, and becomes smooth by that.
#[derive(Debug, Clone)]
pub struct Table {
    range: [f64; 2],
    /// Parameter and numbers, ascending.
    nodes: Vec<Node>,
}

impl Table {
    fn new(sweep: &Sweep, stretch: &Stretch) -> Self {
        let range = [stretch.from, stretch.to];
        let mut place = Workspace::default();
        let angles: Vec<bool> =
            sweep.columns.iter().map(|c| matches!(c.asked.quantity, Quantity::Angle(_))).collect();
        let turns = f64::from(sweep.looks()) / f64::from(super::LOOKS);
        let part = (stretch.to - stretch.from) / (sweep.range[1] - sweep.range[0]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a part of the places")]
        let count = (PLACES * turns * part).ceil().clamp(16.0, 1e6) as u32;
        let mut look = |t: f64, beside: Option<&Node>| -> Node {
            let mut values = sweep.look(input_at(range, t), &stretch.signs, &mut place);
            // An angle goes on from the place beside it.
            for (index, value) in values.iter_mut().enumerate().filter(|(index, _)| angles[*index]) {
                let before = beside.and_then(|node| node.1[index]);
                if let (Some(value), Some(before)) = (value, before) {
                    value.value -= TAU * ((value.value - before.value) / TAU).round();
                }
            }
            (t, values)
        };
        let mut first: Vec<Node> = Vec::new();
        for i in 0..=count {
            let t = (f64::from(i) / f64::from(count)).clamp(END, 1.0 - END);
            let node = look(t, first.last());
            first.push(node);
        }
        let ranges = ranges(&first);
        let mut table = Self { range, nodes: Vec::new() };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "some thousands a turn")]
        let most =
            (f64::from(u32::try_from(MOST_PLACES).unwrap_or(u32::MAX)) * turns * part).max(256.0) as usize;
        let mut left = most.saturating_sub(first.len());
        let mut open: Vec<(Node, u32)> = first.into_iter().rev().map(|node| (node, 0)).collect();
        // From the left: the next place is on top.
        while let Some((node, depth)) = open.pop() {
            let Some(last) = table.nodes.last() else {
                table.nodes.push(node);
                continue;
            };
            if depth < MOST_HALVINGS && left > 0 {
                let middle = look(f64::midpoint(last.0, node.0), Some(last));
                if strays(range, last, &middle, &node, &ranges) {
                    left -= 1;
                    open.push((node, depth + 1));
                    open.push((middle, depth + 1));
                    continue;
                }
            }
            table.nodes.push(node);
        }
        table
    }

    /// At how many places it has numbers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The numbers of the places that were looked at.
    pub fn places(&self) -> impl Iterator<Item = &[Option<Dual>]> {
        self.nodes.iter().map(|node| node.1.as_slice())
    }

    /// Whether it has none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// These columns at a place of the input in the stretch, with their derivatives by the input; `None` for any other
    /// column. Angles go on over half turns.
    #[must_use]
    pub fn at(&self, input: f64, columns: &[usize]) -> Vec<Option<Dual>> {
        let [from, to] = self.range;
        let part = ((f64::midpoint(from, to) - input) / ((to - from) / 2.0)).clamp(-1.0, 1.0);
        self.read(libm::acos(part) / PI, columns)
    }

    fn read(&self, t: f64, columns: &[usize]) -> Vec<Option<Dual>> {
        let after = self.nodes.partition_point(|node| node.0 < t).clamp(1, self.nodes.len().max(2) - 1);
        let [Some(a), Some(b)] = [after - 1, after].map(|index| self.nodes.get(index)) else {
            return Vec::new();
        };
        let t = t.clamp(a.0, b.0);
        let mut values = vec![None; a.1.len()];
        for &column in columns {
            values[column] = between(self.range, a, b, t, column);
        }
        values
    }

    /// The curve that a track of these columns draws in a part of the stretch, within `accuracy` of the page.
    #[must_use]
    pub fn curve(&self, columns: &[usize], range: [f64; 2], track: &Track<'_>, accuracy: f64) -> BezPath {
        /// At so many places one sees whether it moves at all.
        const LOOKS: u32 = 64;
        let course = Course { table: self, columns, range, track, last: RefCell::new(Point::ZERO) };
        let place = |i: u32| course.at(f64::from(i) / f64::from(LOOKS)).0;
        let first = place(0);
        if (1..=LOOKS).all(|i| place(i).distance(first) <= accuracy) {
            // A constant vector has a point for its hodograph, and a point has no curve to be fitted.
            let mut still = BezPath::new();
            still.move_to(first);
            still.line_to(place(LOOKS));
            return still;
        }
        let fitted = fit_to_bezpath(&course, accuracy);
        if has_spikes(&fitted, accuracy) { course.in_strokes() } else { fitted }
    }

    /// The same in short straight strokes, broken where it leaps: forces turn round with the motion that they resist, and
    /// where they do no fitted curve follows them.
    #[must_use]
    pub fn strokes(&self, columns: &[usize], range: [f64; 2], track: &Track<'_>) -> BezPath {
        Course { table: self, columns, range, track, last: RefCell::new(Point::ZERO) }.in_strokes()
    }
}

/// Whether a fitted curve has handles far longer than the piece that they bend: beside a corner that is not seen such a piece
/// keeps within the tolerance where it is looked at, and shoots out between.
fn has_spikes(path: &BezPath, accuracy: f64) -> bool {
    /// A half turn of a circle has handles of two thirds of its chord.
    const LONGEST: f64 = 1.5;
    path.segments().any(|piece| match piece {
        PathSeg::Cubic(cubic) => {
            let handle = cubic.p0.distance(cubic.p1).max(cubic.p2.distance(cubic.p3));
            handle > LONGEST * cubic.p0.distance(cubic.p3) + 8.0 * accuracy
        }
        PathSeg::Line(_) | PathSeg::Quad(_) => false,
    })
}

fn input_at([from, to]: [f64; 2], t: f64) -> f64 {
    f64::midpoint(from, to) - (to - from) / 2.0 * libm::cos(PI * t)
}

/// How fast the input runs.
fn speed_at([from, to]: [f64; 2], t: f64) -> f64 {
    (to - from) / 2.0 * PI * libm::sin(PI * t)
}

/// A column between two places: the cubic with their values and slopes (Hermite).
fn between(range: [f64; 2], a: &Node, b: &Node, t: f64, column: usize) -> Option<Dual> {
    let (from, to) = (a.1[column]?, b.1[column]?);
    let width = b.0 - a.0;
    let s = (t - a.0) / width;
    let (rise, fall) = (from.slope * speed_at(range, a.0) * width, to.slope * speed_at(range, b.0) * width);
    let way = to.value - from.value;
    // From the nearer end, which is met to the last digit.
    let (c, d) = (3.0 * way - 2.0 * rise - fall, rise + fall - 2.0 * way);
    let value = from.value + s * (rise + s * (c + s * d));
    let change = (rise + s * (2.0 * c + 3.0 * s * d)) / width;
    let slope = change / speed_at(range, t.clamp(END, 1.0 - END));
    Some(Dual { value, slope, error: from.error.max(to.error) })
}

/// Whether the cubic between two places misses the look in their middle, or numbers begin or end between them.
fn strays(range: [f64; 2], a: &Node, middle: &Node, b: &Node, ranges: &[[f64; 2]]) -> bool {
    (0..ranges.len()).any(|column| {
        let [low, high] = ranges[column];
        let reach = high - low;
        match (between(range, a, b, middle.0, column), middle.1[column]) {
            (Some(cubic), Some(look)) => {
                // What has gone as far beyond its range grows without end, and is not followed.
                let followed = (low - 4.0 * reach..=high + 4.0 * reach).contains(&look.value);
                let rounding = course::ERRORS * (look.error + cubic.error);
                followed && (cubic.value - look.value).abs() > (STRAY * reach).max(rounding)
            }
            (None, None) => a.1[column].is_some() != b.1[column].is_some(),
            _ => true,
        }
    })
}

/// A part of a stretch as a curve over 0 … 1, the input running as a cosine.
struct Course<'s> {
    table: &'s Table,
    columns: &'s [usize],
    range: [f64; 2],
    track: &'s Track<'s>,
    last: RefCell<Point>,
}

impl Course<'_> {
    fn at(&self, t: f64) -> (Point, Vec2) {
        let t = t.clamp(END, 1.0 - END);
        let input = input_at(self.range, t);
        let values = self.table.at(input, self.columns);
        match (self.track)(input, &values) {
            Some((p, d)) if p.is_finite() && d.is_finite() => {
                *self.last.borrow_mut() = p;
                (p, d * speed_at(self.range, t))
            }
            // Beside a place without a number the curve stands where it was.
            _ => (*self.last.borrow(), Vec2::ZERO),
        }
    }
}

/// Places at which a curve is looked at for jumps, and between which it is drawn in straight strokes where it has some.
const STROKES: u32 = 720;
/// A shorter step from place to place is no jump, mm.
const LEAST_JUMP: f64 = 0.5;

impl Course<'_> {
    fn places(&self) -> impl Iterator<Item = (f64, Point)> + '_ {
        (0..=STROKES).map(|i| {
            let t = f64::from(i) / f64::from(STROKES);
            (t, self.at(t).0)
        })
    }

    /// Whether it leaps between two places however near they are: a load against the motion turns round with it.
    fn leaps(&self, mut low: (f64, Point), mut high: (f64, Point)) -> bool {
        // No finer than the table, whose cubics lead over a leap between two of its places.
        const HALVINGS: u32 = MOST_HALVINGS - 3;
        let whole = low.1.distance(high.1);
        if whole < LEAST_JUMP {
            return false;
        }
        for _ in 0..HALVINGS {
            let t = f64::midpoint(low.0, high.0);
            let middle = (t, self.at(t).0);
            // What runs on smoothly has half of its way in either half.
            if low.1.distance(middle.1) > middle.1.distance(high.1) { high = middle } else { low = middle }
        }
        low.1.distance(high.1) > 0.5 * whole
    }

    /// The curve in short straight strokes, broken where it jumps.
    fn in_strokes(&self) -> BezPath {
        let mut path = BezPath::new();
        let mut last: Option<(f64, Point)> = None;
        for place in self.places() {
            match last {
                Some(before) if !self.leaps(before, place) => path.line_to(place.1),
                _ => path.move_to(place.1),
            }
            last = Some(place);
        }
        path
    }
}

/// This near to a corner counts as one side of it: more than a corner is found to, less than anybody sees.
const BESIDE: f64 = 1e-9;

impl ParamCurveFit for Course<'_> {
    fn sample_pt_tangent(&self, t: f64, sign: f64) -> CurveFitSample {
        // Where the curve has a corner its two sides have different tangents.
        let (p, tangent) = self.at((t + sign.signum() * BESIDE).clamp(0.0, 1.0));
        if tangent.hypot2() > 0.0 {
            return CurveFitSample { p, tangent };
        }
        // A cusp: the direction in which it is left or reached.
        let near = self.at((t + sign * 1e-4).clamp(0.0, 1.0)).0;
        CurveFitSample { p, tangent: (near - p) * sign.signum() }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        self.at(t)
    }

    fn break_cusp(&self, range: Range<f64>) -> Option<f64> {
        /// Between two looks a curve that turns by more than this has a corner.
        const CORNER: f64 = -0.5;
        const LOOKS: u32 = 16;
        const HALVINGS: u32 = 40;
        let step = (range.end - range.start) / f64::from(LOOKS);
        if step < 1e-6 {
            return None;
        }
        // The range may begin at a corner that was found before.
        let mut last = self.at(range.start + BESIDE).1;
        for i in 1..=LOOKS {
            // Nor is a corner at which it ends one of its own.
            let t = (range.start + step * f64::from(i)).min(range.end - BESIDE);
            let now = self.at(t).1;
            if last.dot(now) < CORNER * last.hypot() * now.hypot() {
                // Halved down to the corner itself, or a hook would stick out of the curve.
                let (mut low, mut high) = (t - step, t);
                for _ in 0..HALVINGS {
                    let middle = f64::midpoint(low, high);
                    if self.at(middle).1.dot(last) > 0.0 { low = middle } else { high = middle }
                }
                return Some(low);
            }
            last = now;
        }
        None
    }
}

impl Sweep {
    /// The numbers of a stretch, dense enough to be read between its places.
    #[must_use]
    pub fn table(&self, stretch: &Stretch) -> Table {
        Table::new(self, stretch)
    }

    /// The curve that a track draws in one stretch, or in a part of it, within `accuracy` of the page. For more than one
    /// curve make a [`Sweep::table`] of the stretch.
    #[must_use]
    pub fn curve(&self, stretch: &Stretch, range: [f64; 2], track: &Track<'_>, accuracy: f64) -> BezPath {
        let all: Vec<usize> = (0..self.columns.len()).collect();
        self.table(stretch).curve(&all, range, track, accuracy)
    }
}
