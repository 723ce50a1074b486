//! The board's operations against exact figures (3-4-5 triangles, rational meets) and, with their bounds,
//! against an arithmetic of a hundred digits.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::f64::consts::PI;
use std::marker::PhantomData;

use crate::common::exact::Exact;
use linkgram::board::{Board, Circle, Line, Mm, NoMeet, Operation, Point, Real, Scale, Side, Tape};
use linkgram::double_double::DoubleDouble;
use linkgram::given::Given;
use proptest::prelude::*;

const UNIT: Scale = Scale { si_per_mm: 1.0 };

fn board() -> Board {
    Board::default()
}

fn mm(board: &mut Board, given: Given) -> Mm {
    let amount = board.amount(given);
    board.to_paper(amount, UNIT)
}

fn exact_mm(board: &mut Board, value: f64) -> Mm {
    mm(board, Given::exact(value))
}

fn at(board: &mut Board, x: f64, y: f64) -> Point {
    let (x, y) = (exact_mm(board, x), exact_mm(board, y));
    board.prick(x, y)
}

fn line(board: &mut Board, from: [f64; 2], to: [f64; 2]) -> Line {
    let (a, b) = (at(board, from[0], from[1]), at(board, to[0], to[1]));
    Line { through: a, along: board.toward(a, b, 0).0 }
}

fn circle(board: &mut Board, centre: [f64; 2], radius: f64) -> Circle {
    Circle { centre: at(board, centre[0], centre[1]), radius: exact_mm(board, radius) }
}

/// A scalar is the fraction within its bound, and the bound is a few roundings of numbers of its size.
fn is_fraction(board: &mut Board, length: Mm, numerator: i64, denominator: i64, size: f64) {
    let truth = Exact::ratio(numerator, denominator);
    let bound = board.tape().bound(length.mark());
    let error = truth.error_of(length.value());
    assert!(
        error <= bound,
        "{} is not {numerator}/{denominator}: off by {error:e}, bound {bound:e}",
        length.value()
    );
    assert!(bound <= 100.0 * size * f64::EPSILON, "a bound of {bound:e} for a well-posed figure");
    assert_eq!(board.tape().weakness(length.mark()), None);
}

fn is_point(board: &mut Board, point: Point, x: [i64; 2], y: [i64; 2]) {
    let origin = board.origin();
    let [px, py] = board.between(origin, point);
    is_fraction(board, px, x[0], x[1], 10.0);
    is_fraction(board, py, y[0], y[1], 10.0);
}

// --- exact figures -------------------------------------------------------------------------------------

#[test]
fn lines_of_3_4_5_meet_in_fractions() {
    // The hypotenuse of the triangle (0,0) (4,0) (0,3) and the line through the right angle square to it
    // meet at the foot (36/25, 48/25); the legs' projections are 9/5 and 16/5.
    let b = &mut board();
    let hypotenuse = line(b, [4.0, 0.0], [0.0, 3.0]);
    let height = line(b, [0.0, 0.0], [3.0, 4.0]);
    let meet = b.meet_lines(hypotenuse, height, 0);
    is_point(b, meet.at, [36, 25], [48, 25]);
    is_fraction(b, meet.along[0], 16, 5, 10.0);
    is_fraction(b, meet.along[1], 12, 5, 10.0);
    assert!((meet.crossing - PI / 2.0).abs() < 1e-7);
    // From the other side the signed lengths turn round.
    let back = line(b, [0.0, 3.0], [4.0, 0.0]);
    let meet = b.meet_lines(back, height, 0);
    is_fraction(b, meet.along[0], 9, 5, 10.0);
}

#[test]
fn a_meet_behind_both_points_has_negative_lengths() {
    // y = 1 from (5, 1) to the right and x = 1/3·… : lines y = 1 and 3x = y meet at (1/3, 1).
    let b = &mut board();
    let level = line(b, [5.0, 1.0], [6.0, 1.0]);
    let steep = line(b, [2.0, 6.0], [3.0, 9.0]);
    let meet = b.meet_lines(level, steep, 0);
    is_point(b, meet.at, [1, 3], [1, 1]);
    is_fraction(b, meet.along[0], -14, 3, 10.0);
    assert!(meet.along[1].value() < 0.0);
}

#[test]
fn arcs_of_3_4_5_meet_left_and_right() {
    let b = &mut board();
    let (c1, c2) = (circle(b, [0.0, 0.0], 3.0), circle(b, [5.0, 0.0], 4.0));
    let pair = b.meet_circles(c1, c2, 0).unwrap();
    assert!(!pair.tangent);
    assert!((pair.crossing - PI / 2.0).abs() < 1e-7, "radii of 3-4-5 are square");
    let (left, right) = (b.take(pair, Side::First), b.take(pair, Side::Second));
    is_point(b, left, [9, 5], [12, 5]);
    is_point(b, right, [9, 5], [-12, 5]);
    // Looking before drawing sees the same places.
    assert_eq!(b.look(&pair, Side::First), left.value());
    assert_eq!(b.look(&pair, Side::Second), right.value());
    // From the other centre left and right change.
    let pair = b.meet_circles(c2, c1, 0).unwrap();
    let left = b.take(pair, Side::First);
    is_point(b, left, [9, 5], [-12, 5]);
}

#[test]
fn a_line_cuts_a_circle_in_3_4_5() {
    let b = &mut board();
    let chord = line(b, [-7.0, 3.0], [0.0, 3.0]);
    let round = circle(b, [0.0, 0.0], 5.0);
    let pair = b.meet_line_circle(chord, round, 0).unwrap();
    let (further, nearer) = (b.take(pair, Side::First), b.take(pair, Side::Second));
    is_point(b, further, [4, 1], [3, 1]);
    is_point(b, nearer, [-4, 1], [3, 1]);
    // The line meets the circle at asin(4/5).
    assert!((pair.crossing - libm::asin(0.8)).abs() < 1e-14);
}

#[test]
fn set_square_and_dividers_measure_3_4_5() {
    let b = &mut board();
    let base = line(b, [1.0, 1.0], [4.0, 5.0]);
    let point = at(b, 1.0 - 4.0 + 3.0, 1.0 + 3.0 + 4.0);
    // One length along the base, one square to the left of it.
    let [along, across] = b.square_off(base, point);
    is_fraction(b, along, 5, 1, 10.0);
    is_fraction(b, across, 5, 1, 10.0);
    let distance = b.distance(base.through, point);
    let truth = Exact::ratio(50, 1).sqrt();
    assert!(truth.error_of(distance.value()) <= b.tape().bound(distance.mark()));
}

#[test]
fn division_and_similar_figure() {
    let b = &mut board();
    let (p, q) = (at(b, 1.0, 2.0), at(b, 2.0, 5.0));
    let (one, three) = (exact_mm(b, 1.0), exact_mm(b, 3.0));
    let third = b.ratio(one, three, 0);
    let divided = b.divide(p, q, third);
    is_point(b, divided, [4, 3], [3, 1]);
    // A corner one third along and one third to the left of the base (1, 3): (1/3 − 1, 1 + 1/3).
    let corner = b.similar([p, q], third, third);
    is_point(b, corner, [1, 3], [10, 3]);
}

#[test]
fn directions_turn_exactly() {
    let b = &mut board();
    let (o, p) = (b.origin(), at(b, 3.0, 4.0));
    let (along, length) = b.toward(o, p, 0);
    is_fraction(b, length, 5, 1, 5.0);
    let square = b.quarter_turn(along);
    assert_eq!(square.value(), [-along.value()[1], along.value()[0]]);
    let back = b.reverse(along);
    assert_eq!(back.value(), [-along.value()[0], -along.value()[1]]);
    let five = exact_mm(b, 5.0);
    let left = b.lay_off(p, square, five);
    is_point(b, left, [-1, 1], [7, 1]);
    // Signed lengths go backwards.
    let minus = exact_mm(b, -5.0);
    let home = b.lay_off(p, along, minus);
    is_point(b, home, [0, 1], [0, 1]);
    let quarter = b.angle_between(along, square);
    assert!((quarter.value() - PI / 2.0).abs() <= b.tape().bound(quarter.mark()) + f64::EPSILON);
    let behind = b.angle_between(square, along);
    assert_eq!(behind.value(), -quarter.value());
}

#[test]
fn what_is_laid_off_is_read_back() {
    let b = &mut board();
    for si_per_mm in [0.005, 3.0, 1e-9, 7e11] {
        let scale = Scale { si_per_mm };
        let amount = b.amount(Given::read(0.3 * si_per_mm));
        let paper = b.to_paper(amount, scale);
        let read = b.read(paper, scale);
        assert!((read.value() - amount.value()).abs() <= b.tape().bound(read.mark()));
        assert!(b.tape().bound(read.mark()) <= 10.0 * f64::EPSILON * amount.value());
    }
}

#[test]
fn what_the_textbook_calculates() {
    let b = &mut board();
    let (v, l) = (b.amount(Given::exact(6.0)), b.amount(Given::exact(-4.0)));
    assert_eq!(b.quotient(v, l, 0).value(), -1.5);
    assert_eq!(b.product(v, l).value(), -24.0);
    assert_eq!(b.square_over(v, l, 0).value(), -9.0);
    assert_eq!(b.difference(v, l).value(), 10.0);
    assert_eq!(b.sum(v, l).value(), 2.0);
    assert_eq!(b.magnitude(l).value(), 4.0);
    assert_eq!(b.opposite(l).value(), 4.0);
}

// --- what does not work --------------------------------------------------------------------------------

#[test]
fn figures_that_miss_each_other_do_not_meet() {
    let b = &mut board();
    let about = circle(b, [0.0, 0.0], 3.0);
    let apart = circle(b, [5.0, 0.0], 1.999_999);
    let inside = circle(b, [0.5, 0.0], 2.0);
    assert_eq!(b.meet_circles(about, apart, 0).err(), Some(NoMeet));
    assert_eq!(b.meet_circles(about, inside, 0).err(), Some(NoMeet));
    let passing = line(b, [-7.0, 3.000_001], [0.0, 3.000_001]);
    assert_eq!(b.meet_line_circle(passing, about, 0).err(), Some(NoMeet));
}

#[test]
fn a_tangency_is_one_point_and_weak() {
    let b = &mut board();
    // 0.1 + 0.2 misses 0.3 by a rounding: the arcs still touch.
    for (r1, r2, d) in [(3.0, 2.0, 5.0), (0.1, 0.2, 0.3), (0.7, 0.1, 0.8), (3.0, 1.0, 2.0)] {
        let c1 = Circle { centre: at(b, 0.0, 0.0), radius: mm(b, Given::read(r1)) };
        let x = mm(b, Given::read(d));
        let y = exact_mm(b, 0.0);
        let c2 = Circle { centre: b.prick(x, y), radius: mm(b, Given::read(r2)) };
        let pair = b.meet_circles(c1, c2, 7).unwrap();
        let point = b.take(pair, Side::First);
        assert!(common::norm(common::minus(point.value(), [r1, 0.0])) < 1e-7 * d, "{r1} {r2} {d}");
        let [_, up] = b.between(c1.centre, point);
        assert_eq!(b.tape().weakness(up.mark()), Some(7), "{r1} {r2} {d}");
    }
    let touching = line(b, [-7.0, 3.0], [0.0, 3.0]);
    let about = circle(b, [0.0, 0.0], 3.0);
    let pair = b.meet_line_circle(touching, about, 8).unwrap();
    assert!(pair.tangent);
    let point = b.take(pair, Side::First);
    assert_eq!(point.value(), [0.0, 3.0]);
}

#[test]
fn parallel_lines_are_weak_with_their_reason_and_finite() {
    let b = &mut board();
    let healthy = line(b, [0.0, 1.0], [1.0, 0.0]);
    let first = line(b, [0.0, 0.0], [3.0, 1.0]);
    for second in [line(b, [0.0, 2.0], [3.0, 3.0]), line(b, [0.0, 2.0], [3.0 * 1.1, 2.0 + 1.1])] {
        let meet = b.meet_lines(first, second, 42);
        assert!(meet.at.value().iter().all(|x| x.is_finite()));
        assert!(meet.along.iter().all(|l| l.value().is_finite()));
        assert_eq!(b.tape().weakness(meet.along[0].mark()), Some(42));
        let [x, _] = b.between(first.through, meet.at);
        assert_eq!(b.tape().weakness(x.mark()), Some(42));
    }
    // What does not depend on the weak meet stays sound.
    let meet = b.meet_lines(first, healthy, 43);
    assert_eq!(b.tape().weakness(meet.along[0].mark()), None);
}

#[test]
fn a_direction_between_coinciding_points_is_weak() {
    let b = &mut board();
    let (p, q) = (at(b, 1.0, 2.0), at(b, 1.0, 2.0));
    let (along, _) = b.toward(p, q, 9);
    assert!(along.value().iter().all(|x| x.is_finite()));
    let ten = exact_mm(b, 10.0);
    let end = b.lay_off(p, along, ten);
    let [x, _] = b.between(p, end);
    assert_eq!(b.tape().weakness(x.mark()), Some(9));
}

#[test]
fn an_uncertain_divisor_is_weak_when_its_error_passes_an_eighth() {
    for (error, weak) in [(0.1, false), (0.124, false), (0.126, true), (2.0, true)] {
        let b = &mut board();
        let one = b.amount(Given::exact(1.0));
        let divisor = b.amount(Given::within(-1.0, error));
        let quotient = b.quotient(one, divisor, 5);
        assert_eq!(b.tape().weakness(quotient.mark()).is_some(), weak, "error {error}");
        if !weak {
            let bound = b.tape().bound(quotient.mark());
            assert!(bound >= (1.0 / (1.0 - error) - 1.0), "the bound {bound} covers 1/(1 - {error})");
        }
    }
}

// --- the same without a tape; strokes ------------------------------------------------------------------

#[test]
fn scratch_paper_draws_the_same() {
    fn draw(b: &mut Board) -> [f64; 2] {
        let number = |b: &mut Board, v: f64| {
            let amount = b.amount(Given::read(v));
            b.to_paper(amount, UNIT)
        };
        let (x, r1, r2) = (number(b, 7.1), number(b, 5.3), number(b, 4.4));
        let o = b.origin();
        let zero = number(b, 0.0);
        let p = b.prick(x, zero);
        let pair =
            b.meet_circles(Circle { centre: o, radius: r1 }, Circle { centre: p, radius: r2 }, 0).unwrap();
        let top = b.take(pair, Side::First);
        let (along, _) = b.toward(o, top, 0);
        let square = b.quarter_turn(along);
        let right = b.rightward();
        b.meet_lines(Line { through: top, along: square }, Line { through: p, along: right }, 0).at.value()
    }
    let taped = draw(&mut Board::default());
    let blank = draw(&mut Board::scratch());
    assert_eq!(taped, blank);
}

#[test]
fn every_drawn_point_is_a_stroke_with_its_purpose() {
    let b = &mut board();
    b.purpose("a frame");
    let p = at(b, 3.0, 4.0);
    b.purpose("a meet");
    let (c1, c2) = (circle(b, [0.0, 0.0], 3.0), circle(b, [5.0, 0.0], 4.0));
    let pair = b.meet_circles(c1, c2, 0).unwrap();
    let before = b.tape().strokes().len();
    assert_eq!(before, 3, "three pricks; an arc is no point yet");
    let meet = b.take(pair, Side::First);
    let strokes = b.tape().strokes();
    assert_eq!(
        (strokes[0].operation, strokes[0].at, strokes[0].purpose),
        (Operation::Prick, p.value(), "a frame")
    );
    let last = strokes[before];
    assert_eq!((last.operation, last.at, last.purpose), (Operation::MeetCircles, meet.value(), "a meet"));
}

// --- bounds against a hundred digits -------------------------------------------------------------------

/// Two solutions of one figure: on the board from the given numbers, and exactly from the numbers that
/// might have been meant.
struct Twin<R> {
    board: Board,
    arithmetic: PhantomData<R>,
    /// Relative uncertainty of the given numbers; half a unit in the last place where it is zero.
    uncertainty: f64,
    /// How much of its uncertainty each number uses up, −1 to 1.
    shares: std::vec::IntoIter<f64>,
    claims: Vec<(u32, DoubleDouble, Exact, &'static str)>,
}

type ExactPoint = [Exact; 2];

impl<R: Real> Twin<R> {
    fn new(uncertainty: f64, shares: Vec<f64>) -> Self {
        Self {
            board: Board::new(Tape::of(R::ARITHMETIC)),
            arithmetic: PhantomData,
            uncertainty,
            shares: shares.into_iter(),
            claims: Vec::new(),
        }
    }

    fn given(&mut self, value: f64) -> (Given, Exact) {
        let given = Given::within(value, value.abs() * self.uncertainty.max(R::UNIT_ROUNDOFF));
        let share = self.shares.next().unwrap();
        (given, Exact::of(value) + Exact::of(given.error) * Exact::of(share))
    }

    fn length(&mut self, value: f64) -> (Mm, Exact) {
        let (given, truth) = self.given(value);
        let amount = self.board.amount(given);
        (self.board.to_paper(amount, UNIT), truth)
    }

    fn point(&mut self, value: [f64; 2]) -> (Point, ExactPoint) {
        let (x, tx) = self.length(value[0]);
        let (y, ty) = self.length(value[1]);
        (self.board.prick(x, y), [tx, ty])
    }

    /// A line through two points, not normed on the exact side.
    fn line(&mut self, from: [f64; 2], to: [f64; 2]) -> (Line, ExactPoint, ExactPoint) {
        let ((a, ta), (b, tb)) = (self.point(from), self.point(to));
        let along = self.board.toward(a, b, 0).0;
        let way = [&tb[0] - &ta[0], &tb[1] - &ta[1]];
        let length = Exact::hypot(&way[0], &way[1]);
        (Line { through: a, along }, ta, way.map(|w| w / &length))
    }

    fn claim_length(&mut self, length: Mm, truth: Exact, what: &'static str) {
        let value = self.board.tape().number::<DoubleDouble>(length.mark(), length.value());
        self.claims.push((length.mark(), value, truth, what));
    }

    fn claim_point(&mut self, point: Point, truth: ExactPoint, what: &'static str) {
        let origin = self.board.origin();
        let coordinates = self.board.between(origin, point);
        for (coordinate, truth) in coordinates.into_iter().zip(truth) {
            self.claim_length(coordinate, truth, what);
        }
    }

    /// Every claimed result lies within its bound of the truth; says how many had one.
    fn judge(mut self) -> usize {
        let tape = self.board.tape();
        let mut judged = 0;
        for (mark, value, truth, what) in &self.claims {
            if tape.weakness(*mark).is_some() {
                continue;
            }
            let (error, bound) = (truth.error_of_fine(*value), tape.bound(*mark));
            assert!(error <= bound, "{what}: {value:?} is off by {error:e}, bound {bound:e}");
            judged += 1;
        }
        judged
    }
}

fn shifted(from: &ExactPoint, along: &ExactPoint, by: &Exact) -> ExactPoint {
    [&from[0] + &along[0] * by, &from[1] + &along[1] * by]
}

fn coordinate() -> impl Strategy<Value = f64> {
    -150.0..150.0_f64
}

fn place() -> impl Strategy<Value = [f64; 2]> {
    [coordinate(), coordinate()]
}

/// Half units in the last place, or a length read to eight digits.
fn uncertainty() -> impl Strategy<Value = f64> {
    prop_oneof![Just(0.0), Just(1e-12), Just(1e-8)]
}

fn shares() -> impl Strategy<Value = Vec<f64>> {
    prop::collection::vec(prop_oneof![Just(-1.0), Just(1.0), Just(0.0), -1.0..1.0_f64], 24)
}

/// The laws in one arithmetic.
macro_rules! laws {
    ($name:ident, $real:ty) => {
        mod $name {
            use super::*;

            type R = $real;

proptest! {
    #![proptest_config(common::fixed(400))]

    #[test]
    fn bounds_cover_measuring(p in place(), q in place(), r in place(), u in uncertainty(), s in shares()) {
        let mut t = Twin::<R>::new(u, s);
        let (line, from, along) = t.line(p, q);
        let (point, truth) = t.point(r);
        let way = [&truth[0] - &from[0], &truth[1] - &from[1]];
        let [forward, left] = t.board.square_off(line, point);
        t.claim_length(forward, &way[0] * &along[0] + &way[1] * &along[1], "along");
        t.claim_length(left, &along[0] * &way[1] - &along[1] * &way[0], "across");
        let distance = t.board.distance(line.through, point);
        t.claim_length(distance, Exact::hypot(&way[0], &way[1]), "distance");
        prop_assert!(t.judge() >= 2);
    }

    #[test]
    fn bounds_cover_laying_off(
        p in place(), q in place(), l in coordinate(), a in -10.0..10.0_f64,
        u in uncertainty(), s in shares(),
    ) {
        let mut t = Twin::<R>::new(u, s);
        let (line, from, along) = t.line(p, q);
        let (length, truth) = t.length(l);
        let end = t.board.lay_off(line.through, line.along, length);
        t.claim_point(end, shifted(&from, &along, &truth), "lay off");
        let square = t.board.quarter_turn(line.along);
        let end = t.board.lay_off(line.through, square, length);
        let left = [-along[1].clone(), along[0].clone()];
        t.claim_point(end, shifted(&from, &left, &truth), "lay off square");
        // By protractor, from +x and from the line.
        let (given, angle) = t.given(a);
        let [cos, sin] = angle.cos_sin();
        let drawn = t.board.angle(given);
        let direction = t.board.protractor(drawn);
        let end = t.board.lay_off(line.through, direction, length);
        t.claim_point(end, shifted(&from, &[cos.clone(), sin.clone()], &truth), "protractor");
        let turned = t.board.turned(line.along, drawn);
        let end = t.board.lay_off(line.through, turned, length);
        let way = [&along[0] * &cos - &along[1] * &sin, &along[0] * &sin + &along[1] * &cos];
        t.claim_point(end, shifted(&from, &way, &truth), "turned");
        prop_assert!(t.judge() >= 4);
    }

    #[test]
    fn bounds_cover_angles(p in place(), q in place(), r in place(), u in uncertainty(), s in shares()) {
        let mut t = Twin::<R>::new(u, s);
        let (first, _, along) = t.line(p, q);
        let (second, _, other) = t.line(q, r);
        // The error of an angle is the sine of what is left when it is turned back.
        let left_over = |measured: DoubleDouble, from: &ExactPoint, to: &ExactPoint| {
            let [cos, sin] = Exact::fine(measured).cos_sin();
            let turned = [&from[0] * &cos - &from[1] * &sin, &from[0] * &sin + &from[1] * &cos];
            (&turned[0] * &to[1] - &turned[1] * &to[0]).abs().near()
        };
        let whole = t.board.measure_angle(first.along);
        let between = t.board.angle_between(first.along, second.along);
        let right = [Exact::one(), Exact::zero()];
        let tape = t.board.tape();
        for (angle, from, to) in [(whole, &right, &along), (between, &along, &other)] {
            if tape.weakness(angle.mark()).is_none() {
                let error = left_over(tape.number(angle.mark(), angle.value()), from, to);
                prop_assert!(error <= tape.bound(angle.mark()), "{} off by {error:e}", angle.value());
            }
        }
    }

    #[test]
    fn bounds_cover_the_meet_of_lines(
        p in place(), q in place(), r in place(), v in place(), u in uncertainty(), s in shares(),
    ) {
        let mut t = Twin::<R>::new(u, s);
        let (first, a, da) = t.line(p, q);
        let (second, b, db) = t.line(r, v);
        let meet = t.board.meet_lines(first, second, 0);
        let sin = &da[0] * &db[1] - &da[1] * &db[0];
        prop_assume!(sin.abs().near() > 1e-60);
        let way = [&b[0] - &a[0], &b[1] - &a[1]];
        let along = (&way[0] * &db[1] - &way[1] * &db[0]) / &sin;
        let other = (&way[0] * &da[1] - &way[1] * &da[0]) / &sin;
        t.claim_point(meet.at, shifted(&a, &da, &along), "meet");
        t.claim_length(meet.along[0], along, "along the first");
        t.claim_length(meet.along[1], other, "along the second");
        t.judge();
    }

    #[test]
    fn bounds_cover_nearly_parallel_lines(
        p in place(), q in place(), r in place(), tilt in -9.0..-1.0_f64, u in uncertainty(), s in shares(),
    ) {
        let tilt = libm::pow(10.0, tilt);
        let way = [q[0] - p[0], q[1] - p[1]];
        let v = [r[0] + way[0] - tilt * way[1], r[1] + way[1] + tilt * way[0]];
        let mut t = Twin::<R>::new(u, s);
        let (first, a, da) = t.line(p, q);
        let (second, b, db) = t.line(r, v);
        let meet = t.board.meet_lines(first, second, 0);
        let sin = &da[0] * &db[1] - &da[1] * &db[0];
        prop_assume!(sin.abs().near() > 1e-60);
        let way = [&b[0] - &a[0], &b[1] - &a[1]];
        let along = (&way[0] * &db[1] - &way[1] * &db[0]) / &sin;
        t.claim_point(meet.at, shifted(&a, &da, &along), "flat meet");
        t.claim_length(meet.along[0], along, "along a flat meet");
        t.judge();
    }

    #[test]
    fn bounds_cover_the_meet_of_circles(
        p in place(), q in place(), reach in 0.001..0.999_f64, excess in -7.0..0.0_f64,
        u in uncertainty(), s in shares(),
    ) {
        // Radii whose sum passes the distance by any part of it, down to a grazing meet.
        let distance = common::norm(common::minus(q, p));
        prop_assume!(distance > 1.0);
        let sum = distance * (1.0 + libm::pow(10.0, excess));
        let (r1, r2) = (sum * reach, sum * (1.0 - reach));
        prop_assume!((r1 - r2).abs() < distance);
        let mut t = Twin::<R>::new(u, s);
        let ((c1, a), (c2, b)) = (t.point(p), t.point(q));
        let ((r1, e1), (r2, e2)) = (t.length(r1), t.length(r2));
        let way = [&b[0] - &a[0], &b[1] - &a[1]];
        let d = Exact::hypot(&way[0], &way[1]);
        let foot = (&d * &d + &e1 * &e1 - &e2 * &e2) / (Exact::ratio(2, 1) * &d);
        let square = &e1 * &e1 - &foot * &foot;
        prop_assume!(square > Exact::zero());
        let half = square.sqrt();
        let unit = way.map(|w| w / &d);
        let left = [-unit[1].clone(), unit[0].clone()];
        let middle = shifted(&a, &unit, &foot);
        let pair = t.board.meet_circles(
            Circle { centre: c1, radius: r1 },
            Circle { centre: c2, radius: r2 },
            0,
        );
        prop_assume!(pair.is_ok());
        let pair = pair.unwrap();
        let (first, second) = (t.board.take(pair, Side::First), t.board.take(pair, Side::Second));
        t.claim_point(first, shifted(&middle, &left, &half), "left meet of arcs");
        t.claim_point(second, shifted(&middle, &left, &-half), "right meet of arcs");
        t.judge();
    }

    #[test]
    fn bounds_cover_the_meet_of_line_and_circle(
        p in place(), q in place(), c in place(), excess in -7.0..1.0_f64, u in uncertainty(), s in shares(),
    ) {
        let way = common::minus(q, p);
        prop_assume!(common::norm(way) > 1.0);
        let off = (common::cross(way, common::minus(c, p)) / common::norm(way)).abs();
        prop_assume!(off > 1e-3);
        let mut t = Twin::<R>::new(u, s);
        let (line, from, along) = t.line(p, q);
        let (centre, truth) = t.point(c);
        let (radius, r) = t.length(off * (1.0 + libm::pow(10.0, excess)));
        let way = [&truth[0] - &from[0], &truth[1] - &from[1]];
        let forward = &way[0] * &along[0] + &way[1] * &along[1];
        let across = &along[0] * &way[1] - &along[1] * &way[0];
        let square = &r * &r - &across * &across;
        prop_assume!(square > Exact::zero());
        let half = square.sqrt();
        let pair = t.board.meet_line_circle(line, Circle { centre, radius }, 0);
        prop_assume!(pair.is_ok());
        let pair = pair.unwrap();
        let (first, second) = (t.board.take(pair, Side::First), t.board.take(pair, Side::Second));
        t.claim_point(first, shifted(&from, &along, &(&forward + &half)), "further meet");
        t.claim_point(second, shifted(&from, &along, &(&forward - &half)), "nearer meet");
        t.judge();
    }

    #[test]
    fn bounds_cover_division_and_similarity(
        p in place(), q in place(), part in coordinate(), across in coordinate(), whole in 1.0..150.0_f64,
        u in uncertainty(), s in shares(),
    ) {
        let mut t = Twin::<R>::new(u, s);
        let ((a, ta), (b, tb)) = (t.point(p), t.point(q));
        let ((part, tp), (across, tq), (whole, tw)) = (t.length(part), t.length(across), t.length(whole));
        let (forward, left) = (t.board.ratio(part, whole, 0), t.board.ratio(across, whole, 0));
        let (f, l) = (&tp / &tw, &tq / &tw);
        let way = [&tb[0] - &ta[0], &tb[1] - &ta[1]];
        let divided = t.board.divide(a, b, forward);
        t.claim_point(divided, shifted(&ta, &way, &f), "divide");
        let corner = t.board.similar([a, b], forward, left);
        let turned = [-way[1].clone(), way[0].clone()];
        t.claim_point(corner, shifted(&shifted(&ta, &way, &f), &turned, &l), "similar");
        prop_assert_eq!(t.judge(), 4);
    }
}
        }
    };
}

laws!(single, f32);
laws!(double, f64);
laws!(double_double, DoubleDouble);
