//! The drawing board: points, lines and arcs on paper in millimetres, and the draughtsman's operations.
//!
//! The board writes what it does on a [`Tape`], in the arithmetic that the tape was made for. Every result of a recorded
//! drawing has a bound, computed when somebody asks; scratch paper keeps no record, and its trials cost no more than
//! their arithmetic.
//!
//! Types keep apart what must not be mixed: paper millimetres ([`Mm`]), real quantities ([`Amount`]),
//! angles, points and directions. A [`Scale`] is the only way from one to the other.
//!
//! **Architecture Invariant:** the board does not know what a mechanism is.

mod bounded;
mod bounds;
mod circles;
mod hand;
mod homogeneous;
mod number;
mod op;
mod program;
mod scalar;
mod sketch;
mod tape;
mod trial;
mod waiting;

use std::fmt::Debug;

pub use bounded::{BoundedBlock, BoundedProgram, FEW};
pub use bounds::Judged;
pub use hand::{Hand, Pencil};
pub use homogeneous::{HomogeneousLine, HomogeneousPoint, Location};
pub use number::TOO_LARGE;
pub use op::Op;
pub use program::{
    Block, Dual, FoundByTrial, LANES, Lane, Law, ListedStep, ListedTrial, Listing, LookedFor, Moving,
    Program, Standing, Transcript, Variable, Wanted, Workspace,
};
pub use scalar::{Arithmetic, Real};
pub use tape::{Nudge, Operation, PointRecord, Reason, Tape};
pub use trial::found_by_trial;

/// A recorded scalar.
#[derive(Debug, Clone, Copy)]
pub struct Num {
    /// Rounded to a double.
    value: f64,
    /// Where it stands on the tape.
    mark: u32,
}

macro_rules! scalar_type {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Clone, Copy)]
        pub struct $name(Num);

        impl Debug for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, concat!(stringify!($name), "({})"), self.0.value)
            }
        }

        impl $name {
            /// The value, rounded to a double.
            #[must_use]
            pub fn value(&self) -> f64 {
                self.0.value
            }

            /// Its handle on the tape.
            #[must_use]
            pub fn mark(&self) -> u32 {
                self.0.mark
            }
        }
    };
}

scalar_type! {
    /// A signed length on the paper, millimetres.
    Mm
}
scalar_type! {
    /// A real quantity in SI units: a length of the mechanism, a speed, an angular velocity.
    Amount
}
scalar_type! {
    /// An angle in radians, counter-clockwise positive.
    Angle
}
scalar_type! {
    /// A pure number, as in a division of a line.
    Ratio
}

/// A point on the paper.
#[derive(Debug, Clone, Copy)]
pub struct Point {
    x: Num,
    y: Num,
}

/// A unit vector; not a vector, it has no length.
#[derive(Debug, Clone, Copy)]
pub struct Direction {
    x: Num,
    y: Num,
}

/// A line through a point.
#[derive(Debug, Clone, Copy)]
pub struct Line {
    /// A point of it.
    pub through: Point,
    /// Its direction.
    pub along: Direction,
}

/// A circle, or the arc of one.
#[derive(Debug, Clone, Copy)]
pub struct Circle {
    /// Where the compass stands.
    pub centre: Point,
    /// Its opening.
    pub radius: Mm,
}

impl Point {
    /// Its coordinates, rounded to doubles.
    #[must_use]
    pub fn value(&self) -> [f64; 2] {
        [self.x.value, self.y.value]
    }
}

impl Direction {
    /// Its components, rounded to doubles.
    #[must_use]
    pub fn value(&self) -> [f64; 2] {
        [self.x.value, self.y.value]
    }
}

/// A scale: how many SI units a millimetre of paper stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// SI units per millimetre, positive and finite.
    pub si_per_mm: f64,
}

/// Where two lines meet.
#[derive(Debug, Clone, Copy)]
pub struct Meet {
    /// The point.
    pub at: Point,
    /// Signed length from each line's own point to the meet, along its direction.
    pub along: [Mm; 2],
    /// Angle of crossing, 0 to π/2.
    pub crossing: f64,
}

/// The two points in which a circle meets a line or another circle.
#[derive(Debug, Clone, Copy)]
pub struct Pair {
    operation: Operation,
    middle: Point,
    toward: Direction,
    half: Mm,
    /// Angle of crossing, 0 to π/2.
    pub crossing: f64,
    /// The half chord does not exceed its own error: both points are one.
    pub tangent: bool,
}

/// One of a [`Pair`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Further along the line; or to the left of the first centre looking at the second.
    First,
    /// The other one.
    Second,
}

impl Side {
    /// The other of the two.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::First => Self::Second,
            Self::Second => Self::First,
        }
    }
}

/// Two figures that do not meet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NoMeet;

/// The drawing board.
#[derive(Debug, Clone, Default)]
pub struct Board {
    tape: Tape,
    purpose: &'static str,
}

impl Board {
    /// A clean board with this tape.
    #[must_use]
    pub fn new(tape: Tape) -> Self {
        Self { tape, purpose: "" }
    }

    /// Scratch paper in double precision, for trials: no record, no bounds.
    #[must_use]
    pub fn scratch() -> Self {
        Self::new(Tape::scratch(Arithmetic::Double))
    }

    /// The tape, to ask for bounds.
    pub fn tape(&mut self) -> &mut Tape {
        &mut self.tape
    }

    /// Whether an amount hangs on a division by what may be zero; where nobody may ask, never.
    pub fn is_weak(&mut self, amount: Amount) -> bool {
        self.tape.is_weak(amount.0.mark)
    }

    /// Whether an amount exceeds its error clearly, as a divisor must; where nobody may ask, never.
    pub fn stands_clear(&mut self, amount: Amount) -> bool {
        /// The same eighth by which the tape calls a divisor weak.
        const ERRORS: f64 = 8.0;
        let Num { value, mark } = amount.0;
        self.tape.error(mark).is_some_and(|error| value.abs() > ERRORS * error)
    }

    /// What the next strokes are drawn for; returns what the last ones were drawn for.
    pub fn purpose(&mut self, purpose: &'static str) -> &'static str {
        std::mem::replace(&mut self.purpose, purpose)
    }

    fn stroke(&mut self, operation: Operation, point: Point) -> Point {
        let by = self.tape.stroke(operation, point.value(), [point.x.mark, point.y.mark], self.purpose);
        if by == [0.0; 2] {
            return point;
        }
        Point {
            x: Num { value: point.x.value + by[0], mark: point.x.mark },
            y: Num { value: point.y.value + by[1], mark: point.y.mark },
        }
    }

    // --- between paper and reality -------------------------------------------------------------

    /// The paper length that stands for a real quantity.
    pub fn to_paper(&mut self, amount: Amount, scale: Scale) -> Mm {
        Mm(self.times(amount.0, 1.0 / scale.si_per_mm))
    }

    /// A length read off the paper, multiplied by the scale factor.
    pub fn read(&mut self, length: Mm, scale: Scale) -> Amount {
        // The same factor as in `to_paper`, so that what is laid off is read back as it was.
        let read = self.pencilled(length.0, Pencil::Reading);
        Amount(self.over(read, 1.0 / scale.si_per_mm))
    }

    /// A number of the scene as a real quantity.
    pub fn amount(&mut self, given: crate::given::Given) -> Amount {
        Amount(self.given(given))
    }

    /// A number of the scene as an angle in radians.
    pub fn angle(&mut self, given: crate::given::Given) -> Angle {
        Angle(self.given(given))
    }

    /// The angle of an input, by the input's index: a sweep turns it.
    pub fn input_angle(&mut self, index: usize, given: crate::given::Given) -> Angle {
        Angle(self.input(index, given))
    }

    /// The place of a driven slide, by the input's index: a sweep moves it.
    pub fn input_amount(&mut self, index: usize, given: crate::given::Given) -> Amount {
        Amount(self.input(index, given))
    }

    /// The given rate of an input, by its index: rad/s of a link, m/s of a slide. A sweep over time changes it.
    pub fn input_speed(&mut self, index: usize, given: crate::given::Given) -> Amount {
        Amount(self.input_rate(index, given))
    }

    // --- what the textbook calculates ----------------------------------------------------------

    /// a / b, as in ω = V / l.
    pub fn quotient(&mut self, a: Amount, b: Amount, reason: Reason) -> Amount {
        Amount(self.div(a.0, b.0, reason))
    }

    /// √a, as ω of ω².
    pub fn root(&mut self, a: Amount) -> Amount {
        Amount(self.sqrt(a.0))
    }

    /// a · b, as in V = ω l.
    pub fn product(&mut self, a: Amount, b: Amount) -> Amount {
        Amount(self.mul(a.0, b.0))
    }

    /// v² / l, as in Aⁿ = V² / l.
    pub fn square_over(&mut self, v: Amount, l: Amount, reason: Reason) -> Amount {
        let square = self.mul(v.0, v.0);
        Amount(self.div(square, l.0, reason))
    }

    /// a − b.
    pub fn difference(&mut self, a: Amount, b: Amount) -> Amount {
        Amount(self.sub(a.0, b.0))
    }

    /// a + b.
    pub fn sum(&mut self, a: Amount, b: Amount) -> Amount {
        Amount(self.add(a.0, b.0))
    }

    /// |a|.
    pub fn magnitude(&mut self, a: Amount) -> Amount {
        if a.value() < 0.0 { Amount(self.neg(a.0)) } else { a }
    }

    /// a in the sense of b: a · b / |b|. Whoever evaluates the tape elsewhere finds the sense there.
    pub fn in_sense_of(&mut self, a: Amount, b: Amount, reason: Reason) -> Amount {
        let square = self.mul(b.0, b.0);
        let size = self.sqrt(square);
        let sense = self.div(b.0, size, reason);
        Amount(self.mul(a.0, sense))
    }

    /// The largest whole number that is not greater than a: which turn, or which piece of a table. Whoever evaluates the
    /// tape elsewhere finds it there.
    pub fn whole(&mut self, a: Amount) -> Amount {
        Amount(self.floor(a.0))
    }

    /// An angle as a number of radians.
    pub fn radians(&mut self, angle: Angle) -> Amount {
        Amount(angle.0)
    }

    /// A number of radians as an angle.
    pub fn of_radians(&mut self, radians: Amount) -> Angle {
        Angle(radians.0)
    }

    /// −a.
    pub fn opposite(&mut self, a: Amount) -> Amount {
        Amount(self.neg(a.0))
    }

    /// a / b as a pure number.
    pub fn ratio(&mut self, a: Mm, b: Mm, reason: Reason) -> Ratio {
        Ratio(self.div(a.0, b.0, reason))
    }

    // --- the draughtsman's operations ----------------------------------------------------------

    /// The origin of a diagram: (0, 0), exact.
    pub fn origin(&mut self) -> Point {
        Point { x: self.exact(0.0), y: self.exact(0.0) }
    }

    /// A point that nobody has drawn: whatever is read from it is indeterminate, with this reason.
    pub fn nowhere(&mut self, reason: Reason) -> Point {
        let point = self.origin();
        self.tape.divisor(point.x.mark, 0.0, reason);
        self.tape.divisor(point.y.mark, 0.0, reason);
        point
    }

    /// A direction that nobody has drawn: whatever is read from it is indeterminate, with this reason.
    pub fn no_direction(&mut self, reason: Reason) -> Direction {
        let direction = Direction { x: self.exact(1.0), y: self.exact(0.0) };
        self.tape.divisor(direction.x.mark, 0.0, reason);
        self.tape.divisor(direction.y.mark, 0.0, reason);
        direction
    }

    /// An amount that nobody has read: whatever is calculated from it is indeterminate, with this reason.
    pub fn unknown(&mut self, reason: Reason) -> Amount {
        let amount = self.exact(0.0);
        self.tape.divisor(amount.mark, 0.0, reason);
        Amount(amount)
    }

    /// A point copied from another board, as exact as it stands there.
    pub fn copied(&mut self, at: [f64; 2]) -> Point {
        Point { x: self.exact(at[0]), y: self.exact(at[1]) }
    }

    /// A direction copied from another board.
    pub fn copied_direction(&mut self, d: [f64; 2]) -> Direction {
        Direction { x: self.exact(d[0]), y: self.exact(d[1]) }
    }

    /// The difference of two lengths.
    pub fn less(&mut self, a: Mm, b: Mm) -> Mm {
        Mm(self.sub(a.0, b.0))
    }

    /// An angle as the arc on a circle of one millimetre, so that it can stand where a length is missed.
    pub fn arc_length(&mut self, angle: Angle) -> Mm {
        Mm(angle.0)
    }

    /// Where something stands that was found by trial: an angle, or a way along a guide. Follow it with
    /// [`Board::corrected`].
    pub fn found(&mut self, at: f64) -> Angle {
        Angle(self.tried(crate::given::Given::exact(at)))
    }

    /// One step of false position: what was found less miss / slope. The slope must exceed its error. `unit` is how far
    /// what is tried may go at once: one radian, or a length of the paper.
    pub fn corrected(
        &mut self,
        found: Angle,
        miss: Mm,
        (slope, unit): (crate::given::Given, f64),
        reason: Reason,
    ) -> Angle {
        let slope = self.tried(slope);
        let step = self.div(miss.0, slope, reason);
        let corrected = self.sub(found.0, step);
        self.tape.tried(tape::Trial {
            found: found.mark(),
            miss: miss.mark(),
            slope: slope.mark,
            corrected: corrected.mark,
            unit,
        });
        Angle(corrected)
    }

    /// A part of a quantity.
    pub fn part_of(&mut self, whole: Amount, part: Ratio) -> Amount {
        Amount(self.mul(whole.0, part.0))
    }

    /// Prick a point at given coordinates.
    pub fn prick(&mut self, x: Mm, y: Mm) -> Point {
        let point = Point { x: self.pencilled(x.0, Pencil::Length), y: self.pencilled(y.0, Pencil::Length) };
        self.stroke(Operation::Prick, point)
    }

    /// The direction of an angle from +x, by protractor.
    pub fn protractor(&mut self, angle: Angle) -> Direction {
        let [x, y] = self.cos_sin(angle.0);
        Direction { x, y }
    }

    /// +x.
    pub fn rightward(&mut self) -> Direction {
        Direction { x: self.exact(1.0), y: self.exact(0.0) }
    }

    /// Direction and distance from one point to another.
    pub fn toward(&mut self, from: Point, to: Point, reason: Reason) -> (Direction, Mm) {
        let [dx, dy] = self.between(from, to);
        let square = self.dot(dx.0, dx.0, dy.0, dy.0);
        let length = self.sqrt(square);
        let x = self.div(dx.0, length, reason);
        let y = self.div(dy.0, length, reason);
        (Direction { x, y }, Mm(length))
    }

    /// Distance of two points, by dividers.
    pub fn distance(&mut self, from: Point, to: Point) -> Mm {
        let [dx, dy] = self.between(from, to);
        let square = self.dot(dx.0, dx.0, dy.0, dy.0);
        Mm(self.sqrt(square))
    }

    /// Components of the vector from one point to another.
    pub fn between(&mut self, from: Point, to: Point) -> [Mm; 2] {
        [Mm(self.sub(to.x, from.x)), Mm(self.sub(to.y, from.y))]
    }

    /// A direction turned by +90°, with the set square: exact.
    pub fn quarter_turn(&mut self, d: Direction) -> Direction {
        Direction { x: self.neg(d.y), y: d.x }
    }

    /// The opposite direction.
    pub fn reverse(&mut self, d: Direction) -> Direction {
        Direction { x: self.neg(d.x), y: self.neg(d.y) }
    }

    /// A direction turned by an angle, by protractor.
    pub fn turned(&mut self, d: Direction, by: Angle) -> Direction {
        let [cos, sin] = self.cos_sin(by.0);
        Direction { x: self.cross(d.x, cos, d.y, sin), y: self.dot(d.x, sin, d.y, cos) }
    }

    /// Angle of a direction from +x, by protractor, in (−π, π].
    pub fn measure_angle(&mut self, d: Direction) -> Angle {
        let angle = self.atan2(d.y, d.x);
        Angle(self.pencilled(angle, Pencil::AngleReading))
    }

    /// Angle from one direction to another, ccw, in (−π, π].
    pub fn angle_between(&mut self, from: Direction, to: Direction) -> Angle {
        let sin = self.cross(from.x, to.y, from.y, to.x);
        let cos = self.dot(from.x, to.x, from.y, to.y);
        let angle = self.atan2(sin, cos);
        Angle(self.pencilled(angle, Pencil::AngleReading))
    }

    /// How far a direction has turned since it was `from`, ccw: where a drawing is run on, not only up to half a turn.
    pub fn turned_since(&mut self, from: Direction, to: Direction) -> Angle {
        let sin = self.cross(from.x, to.y, from.y, to.x);
        let cos = self.dot(from.x, to.x, from.y, to.y);
        Angle(self.turned_angle(sin, cos))
    }

    /// A direction for good, as it is in this drawing.
    pub fn as_it_points(&mut self, d: Direction) -> Direction {
        let [x, y] = [d.x, d.y].map(|c| self.exact(c.value));
        Direction { x, y }
    }

    /// A length for good, as it is in this drawing.
    pub fn as_it_stands(&mut self, length: Mm) -> Mm {
        Mm(self.exact(length.0.value))
    }

    /// The angle on whose arc of this radius a length lies.
    pub fn arc_angle(&mut self, length: Mm, radius: Mm, reason: Reason) -> Angle {
        Angle(self.div(length.0, radius.0, reason))
    }

    /// The sum of two angles.
    pub fn angle_sum(&mut self, a: Angle, b: Angle) -> Angle {
        Angle(self.add(a.0, b.0))
    }

    /// The difference of two angles.
    pub fn angle_less(&mut self, a: Angle, b: Angle) -> Angle {
        Angle(self.sub(a.0, b.0))
    }

    /// A part of an angle.
    pub fn part_of_angle(&mut self, whole: Angle, part: Ratio) -> Angle {
        Angle(self.mul(whole.0, part.0))
    }

    /// Angle between two directions, 0 to π.
    pub fn unsigned_angle(&mut self, from: Direction, to: Direction) -> Angle {
        let sin = self.cross(from.x, to.y, from.y, to.x);
        let sin = if sin.value < 0.0 { self.neg(sin) } else { sin };
        let cos = self.dot(from.x, to.x, from.y, to.y);
        let angle = self.atan2(sin, cos);
        Angle(self.pencilled(angle, Pencil::AngleReading))
    }

    /// A line drawn in a direction, as the hand draws it.
    fn drawn(&mut self, d: Direction) -> Direction {
        match self.slip_of_pencil(Pencil::Direction) {
            Some(slip) => self.turned(d, Angle(slip)),
            None => d,
        }
    }

    /// Lay off a signed length from a point along a direction: draw the line, step the length off.
    pub fn lay_off(&mut self, from: Point, along: Direction, length: Mm) -> Point {
        let along = self.drawn(along);
        self.step_off(from, along, length)
    }

    /// Step a signed length off along a line that stands on the paper already.
    pub fn step_off(&mut self, from: Point, along: Direction, length: Mm) -> Point {
        let length = Mm(self.pencilled(length.0, Pencil::Length));
        let point = self.shifted(from, along, length);
        self.stroke(Operation::LayOff, point)
    }

    /// A point moved by two components.
    pub fn moved(&mut self, from: Point, by: [Mm; 2]) -> Point {
        let point = Point { x: self.add(from.x, by[0].0), y: self.add(from.y, by[1].0) };
        self.stroke(Operation::LayOff, point)
    }

    /// An arrow's tip turned clockwise by 90° about its tail, with the set square.
    pub fn turned_about(&mut self, tail: Point, tip: Point) -> Point {
        let [dx, dy] = self.between(tail, tip);
        let down = Mm(self.neg(dx.0));
        self.moved(tail, [dy, down])
    }

    /// An arrow's tip turned counter-clockwise by 90° about its tail.
    pub fn turned_back(&mut self, tail: Point, tip: Point) -> Point {
        let [dx, dy] = self.between(tail, tip);
        let left = Mm(self.neg(dy.0));
        self.moved(tail, [left, dx])
    }

    /// The components of a quantity that has a direction.
    pub fn components(&mut self, along: Direction, size: Amount) -> [Amount; 2] {
        [Amount(self.mul(along.x, size.0)), Amount(self.mul(along.y, size.0))]
    }

    fn shifted(&mut self, from: Point, along: Direction, length: Mm) -> Point {
        let dx = self.mul(along.x, length.0);
        let dy = self.mul(along.y, length.0);
        Point { x: self.add(from.x, dx), y: self.add(from.y, dy) }
    }

    /// How far a point lies along a line and square to it (left positive), with the set square.
    pub fn square_off(&mut self, line: Line, point: Point) -> [Mm; 2] {
        let [dx, dy] = self.between(line.through, point);
        let along = self.dot(dx.0, line.along.x, dy.0, line.along.y);
        let across = self.cross(line.along.x, dy.0, line.along.y, dx.0);
        [Mm(along), Mm(across)]
    }

    /// Where two lines meet, in difference form from the nearer of their two points. Parallel lines
    /// leave a weak divisor with `reason` on the tape.
    pub fn meet_lines(&mut self, first: Line, second: Line, reason: Reason) -> Meet {
        let [first, second] = [first, second].map(|l| Line { along: self.drawn(l.along), ..l });
        let sin = self.cross(first.along.x, second.along.y, first.along.y, second.along.x);
        let [dx, dy] = self.between(first.through, second.through);
        let to_first = self.cross(dx.0, second.along.y, dy.0, second.along.x);
        let to_second = self.cross(dx.0, first.along.y, dy.0, first.along.x);
        let along = [Mm(self.div(to_first, sin, reason)), Mm(self.div(to_second, sin, reason))];
        let from_first = along[0].value().abs() <= along[1].value().abs();
        let at = if from_first {
            self.shifted(first.through, first.along, along[0])
        } else {
            self.shifted(second.through, second.along, along[1])
        };
        let crossing = libm::asin(sin.value.abs().min(1.0));
        Meet { at: self.stroke(Operation::MeetLines, at), along, crossing }
    }

    /// The two points of a line on a circle: [`Side::First`] lies further along the line.
    ///
    /// # Errors
    /// [`NoMeet`] where the line passes the circle by.
    pub fn meet_line_circle(&mut self, line: Line, circle: Circle, reason: Reason) -> Result<Pair, NoMeet> {
        let line = Line { along: self.drawn(line.along), ..line };
        let circle = Circle { radius: Mm(self.pencilled(circle.radius.0, Pencil::Length)), ..circle };
        let [along, across] = self.square_off(line, circle.centre);
        // The centre lies `across` to the left of the line: h² = (r − e)(r + e).
        let less = self.sub(circle.radius.0, across.0);
        let more = self.add(circle.radius.0, across.0);
        let square = self.mul(less, more);
        let (half, tangent) = self.half_chord(square, reason)?;
        let middle = self.shifted(line.through, line.along, along);
        let radius = circle.radius.value();
        let crossing = if radius > 0.0 { libm::asin((half.value() / radius).clamp(0.0, 1.0)) } else { 0.0 };
        Ok(Pair { operation: Operation::MeetLineCircle, middle, toward: line.along, half, crossing, tangent })
    }

    /// The two points in which circles meet: [`Side::First`] lies to the left of the first centre
    /// looking at the second.
    ///
    /// # Errors
    /// [`NoMeet`] where they are too far apart or one lies within the other.
    pub fn meet_circles(&mut self, first: Circle, second: Circle, reason: Reason) -> Result<Pair, NoMeet> {
        let [first, second] =
            [first, second].map(|c| Circle { radius: Mm(self.pencilled(c.radius.0, Pencil::Length)), ..c });
        let (toward, distance) = self.toward(first.centre, second.centre, reason);
        let (d, r1, r2) = (distance.0, first.radius.0, second.radius.0);
        let sum = self.add(r1, r2);
        let gap = self.sub(r1, r2);
        // Foot of the common chord from the first centre: (d + (r1 − r2)(r1 + r2)/d) / 2.
        let product = self.mul(sum, gap);
        let quotient = self.div(product, d, reason);
        let twice = self.add(d, quotient);
        let along = Mm(self.times(twice, 0.5));
        // 16 F² = ((r1 + r2) − d)((r1 + r2) + d)(d − (r1 − r2))(d + (r1 − r2)); h = 2F/d: no
        // cancellation in a needle-shaped triangle.
        let a = self.sub(sum, d);
        let b = self.add(sum, d);
        let c = self.sub(d, gap);
        let e = self.add(d, gap);
        let ab = self.mul(a, b);
        let ce = self.mul(c, e);
        let square = self.mul(ab, ce);
        let (four_f, tangent) = self.half_chord(square, reason)?;
        let chord = self.div(four_f.0, d, reason);
        let half = Mm(self.times(chord, 0.5));
        let middle = self.shifted(first.centre, toward, along);
        let toward = self.quarter_turn(toward);
        let (r1, r2) = (first.radius.value(), second.radius.value());
        let sin = if r1 * r2 > 0.0 { half.value() * distance.value() / (r1 * r2) } else { 0.0 };
        let crossing = libm::asin(sin.clamp(0.0, 1.0));
        Ok(Pair { operation: Operation::MeetCircles, middle, toward, half, crossing, tangent })
    }

    /// √square, where a square below zero by no more than its own error is a tangency.
    fn half_chord(&mut self, square: Num, reason: Reason) -> Result<(Mm, bool), NoMeet> {
        /// A square is as good as zero within this many of its own errors: the same eighth by which
        /// the tape calls a divisor weak.
        const ERRORS: f64 = 8.0;
        let value = square.value;
        self.tape.divisor(square.mark, value, reason);
        let mut tangent = value == 0.0;
        if value <= 0.0 || !value.is_finite() {
            match self.tape.error(square.mark) {
                Some(error) if -value <= ERRORS * error => tangent = true,
                None if value == 0.0 => {}
                _ => return Err(NoMeet),
            }
        }
        Ok((Mm(self.half_root(square)), tangent))
    }

    /// One of the two points of a pair.
    pub fn take(&mut self, pair: Pair, side: Side) -> Point {
        let half = match side {
            Side::First => pair.half,
            Side::Second => Mm(self.neg(pair.half.0)),
        };
        let point = self.shifted(pair.middle, pair.toward, half);
        self.stroke(pair.operation, point)
    }

    /// Where a point of the pair lies, to choose between them before one is drawn.
    #[must_use]
    pub fn look(&self, pair: &Pair, side: Side) -> [f64; 2] {
        let half = match side {
            Side::First => pair.half.value(),
            Side::Second => -pair.half.value(),
        };
        let ([x, y], [dx, dy]) = (pair.middle.value(), pair.toward.value());
        [x + dx * half, y + dy * half]
    }

    /// Divide the line from `from` to `to`: the point at `ratio` of its length.
    pub fn divide(&mut self, from: Point, to: Point, ratio: Ratio) -> Point {
        let [dx, dy] = self.between(from, to);
        let x = self.mul(dx.0, ratio.0);
        let y = self.mul(dy.0, ratio.0);
        let point = Point { x: self.add(from.x, x), y: self.add(from.y, y) };
        let point = self.marked(point);
        self.stroke(Operation::Divide, point)
    }

    /// The corner of a figure similar to one in which the corner lies `along` and `across` (left
    /// positive), as parts of the base.
    pub fn similar(&mut self, base: [Point; 2], along: Ratio, across: Ratio) -> Point {
        let [dx, dy] = self.between(base[0], base[1]);
        let x = self.cross(dx.0, along.0, dy.0, across.0);
        let y = self.dot(dy.0, along.0, dx.0, across.0);
        let point = Point { x: self.add(base[0].x, x), y: self.add(base[0].y, y) };
        let point = self.marked(point);
        self.stroke(Operation::Similar, point)
    }

    /// A point as the hand marks it.
    fn marked(&mut self, point: Point) -> Point {
        Point { x: self.pencilled(point.x, Pencil::Length), y: self.pencilled(point.y, Pencil::Length) }
    }
}
