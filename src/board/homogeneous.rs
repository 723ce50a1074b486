//! Points that may lie off the paper or at infinity, and the lines through them.
//!
//! A [`HomogeneousPoint`] is `base + reach / weight`: homogeneous coordinates in difference form from a point
//! of the paper, so that a near point keeps its digits. At weight zero it is the point at infinity in the
//! direction of `reach`, and nothing is divided on the way there. A [`HomogeneousLine`] is the set of all X with
//! `along × (X − base) = moment`; with `along` zero it is the line at infinity.

use super::number::power_of_two;
use super::tape::{Operation, Reason};
use super::{Amount, Angle, Board, Direction, Line, Num, Point, Ratio, Scale};

/// A point of the extended plane.
#[derive(Debug, Clone, Copy)]
pub struct HomogeneousPoint {
    base: Point,
    reach: [Num; 2],
    weight: Num,
}

/// A line of the extended plane.
#[derive(Debug, Clone, Copy)]
pub struct HomogeneousLine {
    base: Point,
    along: [Num; 2],
    moment: Num,
}

/// Where a point of the extended plane lies.
#[derive(Debug, Clone, Copy)]
pub enum Location {
    /// On the plane of the paper, however far away.
    At(Point),
    /// At infinity; the sign of the direction has no meaning.
    Toward(Direction, Angle),
}

/// Length that counts as much as a weight of one where both are compared: the order of paper numbers, mm.
const PAPER: f64 = 128.0;

/// A number is as good as zero within this many of its own errors: the eighth by which the tape calls a divisor
/// weak.
const ERRORS: f64 = 8.0;

impl HomogeneousPoint {
    /// Rounded homogeneous coordinates (x, y, w), with w counted in paper lengths: all three are of one order.
    #[must_use]
    pub fn look(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let weight = self.weight.value;
        let reach = self.reach.map(|n| n.value);
        let all = [reach[0] + weight * x, reach[1] + weight * y, weight * PAPER];
        let size = all.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if size > 0.0 { all.map(|v| v / size) } else { all }
    }
}

impl HomogeneousPoint {
    /// Rounded homogeneous coordinates: the point (x, y)/w of the paper, in millimetres.
    #[must_use]
    pub fn in_paper(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let weight = self.weight.value;
        let reach = self.reach.map(|n| n.value);
        [reach[0] + weight * x, reach[1] + weight * y, weight]
    }
}

impl HomogeneousLine {
    /// Rounded coordinates (a, b, c) of the line a x + b y + c w = 0, with w counted as in
    /// [`HomogeneousPoint::look`].
    #[must_use]
    pub fn look(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let [u, v] = self.along.map(|n| n.value);
        let all = [-v, u, (v * x - u * y - self.moment.value) / PAPER];
        let size = all.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if size > 0.0 { all.map(|v| v / size) } else { all }
    }
}

impl Board {
    /// A point of the paper as a point of the extended plane.
    pub fn proper(&mut self, point: Point) -> HomogeneousPoint {
        HomogeneousPoint { base: point, reach: [self.exact(0.0), self.exact(0.0)], weight: self.exact(1.0) }
    }

    /// The point at infinity in a direction.
    pub fn at_infinity(&mut self, direction: Direction) -> HomogeneousPoint {
        let base = self.origin();
        // As long as the paper, so that it weighs as much as a proper point.
        let reach = [self.times(direction.x, PAPER), self.times(direction.y, PAPER)];
        HomogeneousPoint { base, reach, weight: self.exact(0.0) }
    }

    /// A line of the paper as a line of the extended plane.
    pub fn extended(&mut self, line: Line) -> HomogeneousLine {
        HomogeneousLine { base: line.through, along: [line.along.x, line.along.y], moment: self.exact(0.0) }
    }

    /// The vector from one point to another, times both weights: finite whatever the points are.
    fn run(&mut self, from: HomogeneousPoint, to: HomogeneousPoint) -> [Num; 2] {
        let between = self.between(from.base, to.base);
        let weights = self.mul(from.weight, to.weight);
        [0, 1].map(|k| {
            let bases = self.mul(weights, between[k].0);
            let reaches = self.cross(from.weight, to.reach[k], to.weight, from.reach[k]);
            self.add(bases, reaches)
        })
    }

    /// The line through two points; `None` where they coincide.
    pub fn join(&mut self, p: HomogeneousPoint, q: HomogeneousPoint) -> Option<HomogeneousLine> {
        // From the heavier of the two: the lighter may be at infinity.
        let (p, q) = if p.weight.value.abs() >= q.weight.value.abs() { (p, q) } else { (q, p) };
        let along = self.run(p, q);
        // Moment of q about p's base: w_q (Q − P) × u_p + u_q × u_p.
        let between = self.between(p.base, q.base);
        let arm = [0, 1].map(|k| {
            let far = self.mul(q.weight, between[k].0);
            self.add(far, q.reach[k])
        });
        let moment = self.cross(arm[0], p.reach[1], arm[1], p.reach[0]);
        let line = HomogeneousLine { base: p.base, along, moment };
        let vanishes = [along[0], along[1], moment].map(|n| self.vanishes(n));
        if vanishes == [true; 3] { None } else { Some(self.normalized_line(line)) }
    }

    /// Where two lines meet, at infinity where they are parallel; `None` where they are one line.
    pub fn cross_lines(
        &mut self,
        first: HomogeneousLine,
        second: HomogeneousLine,
    ) -> Option<HomogeneousPoint> {
        let between = self.between(first.base, second.base);
        // The second line's moment about the first one's base.
        let carried = self.cross(second.along[0], between[1].0, second.along[1], between[0].0);
        let moment = self.add(second.moment, carried);
        let weight = self.cross(first.along[0], second.along[1], first.along[1], second.along[0]);
        let reach = [0, 1].map(|k| self.cross(first.moment, second.along[k], moment, first.along[k]));
        let point = HomogeneousPoint { base: first.base, reach, weight };
        let vanishes = [reach[0], reach[1], weight].map(|n| self.vanishes(n));
        if vanishes == [true; 3] {
            return None;
        }
        Some(self.normalized_point(point))
    }

    /// Whether a number is zero as far as its own error tells.
    pub(super) fn vanishes(&mut self, n: Num) -> bool {
        let value = n.value.abs();
        value == 0.0 || self.tape.error(n.mark).is_some_and(|error| value <= ERRORS * error)
    }

    /// The same point with numbers of order one, by a power of two.
    fn normalized_point(&mut self, p: HomogeneousPoint) -> HomogeneousPoint {
        let size = p.reach.iter().map(|n| n.value.abs() / PAPER);
        let factor = power_of_two(size.fold(p.weight.value.abs(), f64::max));
        HomogeneousPoint {
            base: p.base,
            reach: p.reach.map(|n| self.times(n, factor)),
            weight: self.times(p.weight, factor),
        }
    }

    fn normalized_line(&mut self, l: HomogeneousLine) -> HomogeneousLine {
        let size = l.along.iter().map(|n| n.value.abs());
        let factor = power_of_two(size.fold(l.moment.value.abs() / PAPER, f64::max));
        HomogeneousLine {
            base: l.base,
            along: l.along.map(|n| self.times(n, factor)),
            moment: self.times(l.moment, factor),
        }
    }

    /// Finds a point on the paper, as a stroke; or its direction where it lies at infinity as far as anybody can
    /// tell: where its weight is not so clear of its error that one may divide by it.
    pub fn locate(&mut self, p: HomogeneousPoint, reason: Reason) -> Location {
        if self.vanishes(p.weight) {
            let direction = self.unit(p.reach, reason);
            // The half turn that a line's direction leaves open is chosen here, once.
            let angle = self.measure_angle(direction);
            return Location::Toward(direction, angle);
        }
        let away = p.reach.iter().any(|n| n.value != 0.0);
        if !away {
            return Location::At(p.base);
        }
        let by = p.reach.map(|n| self.div(n, p.weight, reason));
        let point = Point { x: self.add(p.base.x, by[0]), y: self.add(p.base.y, by[1]) };
        Location::At(self.stroke(Operation::MeetLines, point))
    }

    /// A point by division, wherever it lies now, and beside it its homogeneous coordinates in difference form: the
    /// reach and the weight. For a drawing that is written down to be run elsewhere, where the point may lie at infinity
    /// though it does not here, or the other way.
    pub fn coordinates(&mut self, p: HomogeneousPoint, reason: Reason) -> (Point, [Amount; 2], Amount) {
        let by = p.reach.map(|n| self.div(n, p.weight, reason));
        let point = Point { x: self.add(p.base.x, by[0]), y: self.add(p.base.y, by[1]) };
        (point, p.reach.map(Amount), Amount(p.weight))
    }

    fn unit(&mut self, v: [Num; 2], reason: Reason) -> Direction {
        let square = self.dot(v[0], v[0], v[1], v[1]);
        let length = self.sqrt(square);
        Direction { x: self.div(v[0], length, reason), y: self.div(v[1], length, reason) }
    }

    /// The ratio of two segments `from`–`to` and `other`–`to` of one line, signed: what two velocities that are equal
    /// at `to` make of the rates about `from` and `other`. `None` where both segments vanish.
    ///
    /// Each segment is the run between its ends times both their weights, so that the ratio of a segment that
    /// ends at infinity is finite as well; the common weight of `to` drops out.
    pub fn segments(
        &mut self,
        from: HomogeneousPoint,
        other: HomogeneousPoint,
        to: HomogeneousPoint,
        reason: Reason,
    ) -> Option<Ratio> {
        let (first, second) = (self.run(from, to), self.run(other, to));
        let longer = if norm(&first) >= norm(&second) { first } else { second };
        if longer.iter().all(|n| self.vanishes(*n)) {
            return self.segments_at_infinity([from, other, to], reason);
        }
        let along = self.unit(longer, reason);
        let first = self.dot(first[0], along.x, first[1], along.y);
        let second = self.dot(second[0], along.x, second[1], along.y);
        Some(Ratio(self.div(first, second, reason)))
    }

    /// [`Board::segments`] of three points at infinity: bodies that translate have velocities whose difference is
    /// square to the direction of their centre.
    fn segments_at_infinity(&mut self, points: [HomogeneousPoint; 3], reason: Reason) -> Option<Ratio> {
        let [from, other, to] = points;
        if !points.into_iter().all(|p| self.vanishes(p.weight)) {
            return None;
        }
        let moment = |board: &mut Self, p: HomogeneousPoint| {
            board.cross(p.reach[0], to.reach[1], p.reach[1], to.reach[0])
        };
        let (first, second) = (moment(self, from), moment(self, other));
        if self.vanishes(first) && self.vanishes(second) {
            return None;
        }
        Some(Ratio(self.div(first, second, reason)))
    }

    /// The velocity of a point of a body that turns about a centre: square to the radius, `rate` times its length.
    /// `rate` is ω over the centre's weight: for a centre at infinity the velocity of the translation.
    pub fn velocity_about(
        &mut self,
        centre: HomogeneousPoint,
        rate: Amount,
        point: Point,
        scale: Scale,
    ) -> [Amount; 2] {
        let radius = self.between(centre.base, point);
        let [x, y] = [0, 1].map(|k| {
            let far = self.mul(centre.weight, radius[k].0);
            let run = self.sub(far, centre.reach[k]);
            let metres = self.times(run, scale.si_per_mm);
            self.mul(metres, rate.0)
        });
        [Amount(self.neg(y)), Amount(x)]
    }

    /// ω of a body from its rate about a centre: the rate times the centre's weight, zero for a centre at
    /// infinity.
    pub fn turning(&mut self, centre: HomogeneousPoint, rate: Amount) -> Amount {
        Amount(self.mul(centre.weight, rate.0))
    }

    /// The rate of a body about its centre that turns it with ω: the reverse of [`Board::turning`].
    pub fn rate_of(&mut self, centre: HomogeneousPoint, omega: Amount, reason: Reason) -> Amount {
        Amount(self.div(omega.0, centre.weight, reason))
    }

    /// The direction from a point of the paper to a point of the extended plane.
    pub fn direction_to(&mut self, from: Point, to: HomogeneousPoint, reason: Reason) -> Direction {
        let from = self.proper(from);
        let run = self.run(from, to);
        self.unit(run, reason)
    }

    /// The rate of a body about its centre from the velocity of one of its points; see [`Board::velocity_about`].
    pub fn rate_about(
        &mut self,
        centre: HomogeneousPoint,
        point: Point,
        velocity: [Amount; 2],
        scale: Scale,
        reason: Reason,
    ) -> Amount {
        let radius = self.between(centre.base, point);
        let run = [0, 1].map(|k| {
            let far = self.mul(centre.weight, radius[k].0);
            let run = self.sub(far, centre.reach[k]);
            self.times(run, scale.si_per_mm)
        });
        // rate = (run × v) / run².
        let moment = self.cross(run[0], velocity[1].0, run[1], velocity[0].0);
        let square = self.dot(run[0], run[0], run[1], run[1]);
        Amount(self.div(moment, square, reason))
    }

    /// The pole of a body from the velocity of one of its points: on the normal to it, at the distance V / ω.
    /// `None` where the body is at rest.
    pub fn on_normal(
        &mut self,
        point: Point,
        velocity: [Amount; 2],
        omega: Amount,
        scale: Scale,
    ) -> Option<HomogeneousPoint> {
        let per_mm = 1.0 / scale.si_per_mm;
        let back = self.neg(velocity[1].0);
        let reach = [self.times(back, per_mm), self.times(velocity[0].0, per_mm)];
        let still = [reach[0], reach[1], omega.0].map(|n| self.vanishes(n)) == [true; 3];
        let point = HomogeneousPoint { base: point, reach, weight: omega.0 };
        if still { None } else { Some(self.normalized_point(point)) }
    }
}

fn norm(v: &[Num; 2]) -> f64 {
    libm::hypot(v[0].value, v[1].value)
}
