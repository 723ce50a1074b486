//! Points that may lie off the paper or at infinity, and the lines through them.
//!
//! A [`HomogeneousPoint`] is `base + reach / weight`: homogeneous coordinates in difference form from a point
//! of the paper, so that a near point keeps its digits. At weight zero it is the point at infinity in the
//! direction of `reach`, and nothing is divided on the way there. A [`HomogeneousLine`] is the set of all X with
//! `along × (X − base) = moment`; with `along` zero it is the line at infinity.

use super::reckon::power_of_two;
use super::scalar::Real;
use super::tape::{Operation, Reason, Recorder};
use super::{Amount, Angle, Bench, Board, Direction, Line, Num, Point, Ratio, Scale, copy_type};

/// A point of the extended plane.
pub struct HomogeneousPoint<B: Bench> {
    base: Point<B>,
    reach: [Num<B>; 2],
    weight: Num<B>,
}

/// A line of the extended plane.
pub struct HomogeneousLine<B: Bench> {
    base: Point<B>,
    along: [Num<B>; 2],
    moment: Num<B>,
}

/// Where a point of the extended plane lies.
pub enum Location<B: Bench> {
    /// On the plane of the paper, however far away.
    At(Point<B>),
    /// At infinity; the sign of the direction has no meaning.
    Toward(Direction<B>, Angle<B>),
}

copy_type!(HomogeneousPoint, HomogeneousLine, Location);

/// Length that counts as much as a weight of one where both are compared: the order of paper numbers, mm.
const PAPER: f64 = 128.0;

/// A number is as good as zero within this many of its own errors: the eighth by which the tape calls a divisor
/// weak.
const ERRORS: f64 = 8.0;

impl<B: Bench> HomogeneousPoint<B> {
    /// Rounded homogeneous coordinates (x, y, w), with w counted in paper lengths: all three are of one order.
    #[must_use]
    pub fn look(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let weight = self.weight.value.to_f64();
        let reach = self.reach.map(|n| n.value.to_f64());
        let all = [reach[0] + weight * x, reach[1] + weight * y, weight * PAPER];
        let size = all.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if size > 0.0 { all.map(|v| v / size) } else { all }
    }
}

impl<B: Bench> HomogeneousPoint<B> {
    /// Rounded homogeneous coordinates: the point (x, y)/w of the paper, in millimetres.
    #[must_use]
    pub fn in_paper(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let weight = self.weight.value.to_f64();
        let reach = self.reach.map(|n| n.value.to_f64());
        [reach[0] + weight * x, reach[1] + weight * y, weight]
    }
}

impl<B: Bench> HomogeneousLine<B> {
    /// Rounded coordinates (a, b, c) of the line a x + b y + c w = 0, with w counted as in
    /// [`HomogeneousPoint::look`].
    #[must_use]
    pub fn look(&self) -> [f64; 3] {
        let [x, y] = self.base.value();
        let [u, v] = self.along.map(|n| n.value.to_f64());
        let all = [-v, u, (v * x - u * y - self.moment.value.to_f64()) / PAPER];
        let size = all.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        if size > 0.0 { all.map(|v| v / size) } else { all }
    }
}

impl<B: Bench> Board<B> {
    /// A point of the paper as a point of the extended plane.
    pub fn proper(&mut self, point: Point<B>) -> HomogeneousPoint<B> {
        HomogeneousPoint { base: point, reach: [self.exact(0.0), self.exact(0.0)], weight: self.exact(1.0) }
    }

    /// The point at infinity in a direction.
    pub fn at_infinity(&mut self, direction: Direction<B>) -> HomogeneousPoint<B> {
        let base = self.origin();
        // As long as the paper, so that it weighs as much as a proper point.
        let reach = [self.times(direction.x, PAPER), self.times(direction.y, PAPER)];
        HomogeneousPoint { base, reach, weight: self.exact(0.0) }
    }

    /// A line of the paper as a line of the extended plane.
    pub fn extended(&mut self, line: Line<B>) -> HomogeneousLine<B> {
        HomogeneousLine { base: line.through, along: [line.along.x, line.along.y], moment: self.exact(0.0) }
    }

    /// The vector from one point to another, times both weights: finite whatever the points are.
    fn run(&mut self, from: HomogeneousPoint<B>, to: HomogeneousPoint<B>) -> [Num<B>; 2] {
        let between = self.between(from.base, to.base);
        let weights = self.mul(from.weight, to.weight);
        [0, 1].map(|k| {
            let bases = self.mul(weights, between[k].0);
            let reaches = self.cross(from.weight, to.reach[k], to.weight, from.reach[k]);
            self.add(bases, reaches)
        })
    }

    /// The line through two points; `None` where they coincide.
    pub fn join(&mut self, p: HomogeneousPoint<B>, q: HomogeneousPoint<B>) -> Option<HomogeneousLine<B>> {
        // From the heavier of the two: the lighter may be at infinity.
        let (p, q) =
            if p.weight.value.to_f64().abs() >= q.weight.value.to_f64().abs() { (p, q) } else { (q, p) };
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
        first: HomogeneousLine<B>,
        second: HomogeneousLine<B>,
    ) -> Option<HomogeneousPoint<B>> {
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
    pub(super) fn vanishes(&mut self, n: Num<B>) -> bool {
        let value = n.value.to_f64().abs();
        value == 0.0 || self.recorder.error(n.mark).is_some_and(|error| value <= ERRORS * error)
    }

    /// The same point with numbers of order one, by a power of two.
    fn normalized_point(&mut self, p: HomogeneousPoint<B>) -> HomogeneousPoint<B> {
        let size = p.reach.iter().map(|n| n.value.to_f64().abs() / PAPER);
        let factor = power_of_two(size.fold(p.weight.value.to_f64().abs(), f64::max));
        HomogeneousPoint {
            base: p.base,
            reach: p.reach.map(|n| self.times(n, factor)),
            weight: self.times(p.weight, factor),
        }
    }

    fn normalized_line(&mut self, l: HomogeneousLine<B>) -> HomogeneousLine<B> {
        let size = l.along.iter().map(|n| n.value.to_f64().abs());
        let factor = power_of_two(size.fold(l.moment.value.to_f64().abs() / PAPER, f64::max));
        HomogeneousLine {
            base: l.base,
            along: l.along.map(|n| self.times(n, factor)),
            moment: self.times(l.moment, factor),
        }
    }

    /// Finds a point on the paper, as a stroke; or its direction where it lies at infinity as far as anybody can
    /// tell. Between the two, where its weight is neither zero nor clear of its error, the point is on the paper
    /// with a weak divisor and `reason` on the tape.
    pub fn locate(&mut self, p: HomogeneousPoint<B>, reason: Reason) -> Location<B> {
        let weight = p.weight.value.to_f64().abs();
        let lost = weight == 0.0 || self.recorder.error(p.weight.mark).is_some_and(|error| weight <= error);
        if lost {
            let direction = self.unit(p.reach, reason);
            // The half turn that a line's direction leaves open is chosen here, once.
            let angle = self.measure_angle(direction);
            return Location::Toward(direction, angle);
        }
        let away = p.reach.iter().any(|n| n.value.to_f64() != 0.0);
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
    pub fn coordinates(
        &mut self,
        p: HomogeneousPoint<B>,
        reason: Reason,
    ) -> (Point<B>, [Amount<B>; 2], Amount<B>) {
        let by = p.reach.map(|n| self.div(n, p.weight, reason));
        let point = Point { x: self.add(p.base.x, by[0]), y: self.add(p.base.y, by[1]) };
        (point, p.reach.map(Amount), Amount(p.weight))
    }

    fn unit(&mut self, v: [Num<B>; 2], reason: Reason) -> Direction<B> {
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
        from: HomogeneousPoint<B>,
        other: HomogeneousPoint<B>,
        to: HomogeneousPoint<B>,
        reason: Reason,
    ) -> Option<Ratio<B>> {
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
    fn segments_at_infinity(&mut self, points: [HomogeneousPoint<B>; 3], reason: Reason) -> Option<Ratio<B>> {
        let [from, other, to] = points;
        if !points.into_iter().all(|p| self.vanishes(p.weight)) {
            return None;
        }
        let moment = |board: &mut Self, p: HomogeneousPoint<B>| {
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
        centre: HomogeneousPoint<B>,
        rate: Amount<B>,
        point: Point<B>,
        scale: Scale,
    ) -> [Amount<B>; 2] {
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
    pub fn turning(&mut self, centre: HomogeneousPoint<B>, rate: Amount<B>) -> Amount<B> {
        Amount(self.mul(centre.weight, rate.0))
    }

    /// The rate of a body about its centre that turns it with ω: the reverse of [`Board::turning`].
    pub fn rate_of(&mut self, centre: HomogeneousPoint<B>, omega: Amount<B>, reason: Reason) -> Amount<B> {
        Amount(self.div(omega.0, centre.weight, reason))
    }

    /// The direction from a point of the paper to a point of the extended plane.
    pub fn direction_to(&mut self, from: Point<B>, to: HomogeneousPoint<B>, reason: Reason) -> Direction<B> {
        let from = self.proper(from);
        let run = self.run(from, to);
        self.unit(run, reason)
    }

    /// The rate of a body about its centre from the velocity of one of its points; see [`Board::velocity_about`].
    pub fn rate_about(
        &mut self,
        centre: HomogeneousPoint<B>,
        point: Point<B>,
        velocity: [Amount<B>; 2],
        scale: Scale,
        reason: Reason,
    ) -> Amount<B> {
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
        point: Point<B>,
        velocity: [Amount<B>; 2],
        omega: Amount<B>,
        scale: Scale,
    ) -> Option<HomogeneousPoint<B>> {
        let per_mm = 1.0 / scale.si_per_mm;
        let back = self.neg(velocity[1].0);
        let reach = [self.times(back, per_mm), self.times(velocity[0].0, per_mm)];
        let still = [reach[0], reach[1], omega.0].map(|n| self.vanishes(n)) == [true; 3];
        let point = HomogeneousPoint { base: point, reach, weight: omega.0 };
        if still { None } else { Some(self.normalized_point(point)) }
    }
}

fn norm<B: Bench>(v: &[Num<B>; 2]) -> f64 {
    libm::hypot(v[0].value.to_f64(), v[1].value.to_f64())
}
