//! Scalar reckoning on the tape: each operation writes its partial derivatives and its own rounding.

use super::scalar::Real;
use super::tape::{Pencil, Reason, Reckoning, Recorder};
use super::{Bench, Board, Num};
use crate::given::Given;

/// The reason of a number too large for the arithmetic.
pub const TOO_LARGE: Reason = Reason::MAX;

impl<B: Bench> Board<B> {
    /// A number of the scene, with its uncertainty.
    pub fn given(&mut self, given: Given) -> Num<B> {
        let (value, error) = B::Real::from_given(given);
        let (value, finite) = finite(value);
        let mark = self.recorder.given(value.to_f64(), error);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    /// The place of an input, which a sweep varies.
    pub(super) fn input(&mut self, index: usize, given: Given) -> Num<B> {
        let (value, error) = B::Real::from_given(given);
        let (value, finite) = finite(value);
        let mark = self.recorder.input(index, value.to_f64(), error);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    /// The rate of an input, which changes in a sweep over time.
    pub(super) fn input_rate(&mut self, index: usize, given: Given) -> Num<B> {
        let (value, error) = B::Real::from_given(given);
        let (value, finite) = finite(value);
        let mark = self.recorder.input_rate(index, value.to_f64(), error);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    /// An exact number.
    pub fn exact(&mut self, value: f64) -> Num<B> {
        self.given(Given::exact(value))
    }

    /// A number that the hand has pencilled: what should stand there, and how far the pencil missed it.
    pub(super) fn pencilled(&mut self, num: Num<B>, kind: Pencil) -> Num<B> {
        match self.slip_of_pencil(kind) {
            Some(slip) => self.add(num, slip),
            None => num,
        }
    }

    /// How far the pencil misses this time; `None` where the hand is perfect.
    pub(super) fn slip_of_pencil(&mut self, kind: Pencil) -> Option<Num<B>> {
        let (value, mark) = self.recorder.pencil(kind)?;
        Some(Num { value: B::Real::from_f64(value), mark })
    }

    fn in_range(&mut self, mark: super::MarkOf<B>, finite: bool) {
        if !finite {
            self.recorder.divisor(mark, 0.0, TOO_LARGE);
        }
    }

    fn push(&mut self, step: Reckoning, value: B::Real, parts: &[(Num<B>, f64)], inner: f64) -> Num<B> {
        let (value, finite) = finite(value);
        let rounding = inner + B::Real::rounding(value.to_f64());
        self.rounded(step, value, parts, rounding, finite)
    }

    fn rounded(
        &mut self,
        step: Reckoning,
        value: B::Real,
        parts: &[(Num<B>, f64)],
        rounding: f64,
        finite: bool,
    ) -> Num<B> {
        let mut marks = [(Default::default(), 0.0); 4];
        for (to, (num, partial)) in marks.iter_mut().zip(parts) {
            *to = (num.mark, *partial);
        }
        let mark = self.recorder.result(step, &marks[..parts.len().min(4)], rounding);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    pub(super) fn add(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        let (value, finite) = finite(a.value + b.value);
        let rounding = B::Real::rounding_of_sum(a.value, b.value, value);
        self.rounded(Reckoning::Sum, value, &[(a, 1.0), (b, 1.0)], rounding, finite)
    }

    pub(super) fn sub(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        let (value, finite) = finite(a.value - b.value);
        let rounding = B::Real::rounding_of_sum(a.value, -b.value, value);
        self.rounded(Reckoning::Difference, value, &[(a, 1.0), (b, -1.0)], rounding, finite)
    }

    /// −a, exact.
    pub(super) fn neg(&mut self, a: Num<B>) -> Num<B> {
        Num { value: -a.value, mark: self.recorder.result(Reckoning::Opposite, &[(a.mark, -1.0)], 0.0) }
    }

    pub(super) fn mul(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        let value = a.value * b.value;
        let (fa, fb) = (a.value.to_f64(), b.value.to_f64());
        let inner = underflow::<B::Real>(value.to_f64(), fa != 0.0 && fb != 0.0);
        self.push(Reckoning::Product, value, &[(a, fb), (b, fa)], inner)
    }

    /// a · factor for an exact factor.
    pub(super) fn times(&mut self, a: Num<B>, factor: f64) -> Num<B> {
        let rounded = B::Real::from_f64(factor);
        let value = a.value * rounded;
        let inner = value.to_f64().abs() * factor_error::<B::Real>(factor)
            + underflow::<B::Real>(value.to_f64(), a.value.to_f64() != 0.0);
        self.push(Reckoning::Times(factor), value, &[(a, factor)], inner)
    }

    /// a / divisor for an exact divisor that is not zero.
    pub(super) fn over(&mut self, a: Num<B>, divisor: f64) -> Num<B> {
        let value = a.value / B::Real::from_f64(divisor);
        let inner = value.to_f64().abs() * factor_error::<B::Real>(divisor)
            + underflow::<B::Real>(value.to_f64(), a.value.to_f64() != 0.0);
        self.push(Reckoning::Over(divisor), value, &[(a, 1.0 / divisor)], inner)
    }

    /// a / b. A divisor that does not stand clear of its error is on the tape with its reason; the
    /// value is then meaningless but finite.
    pub(super) fn div(&mut self, a: Num<B>, b: Num<B>, reason: Reason) -> Num<B> {
        let divisor = b.value.to_f64();
        self.recorder.divisor(b.mark, divisor, reason);
        let value = a.value / b.value;
        let quotient = value.to_f64();
        let (value, by_a, by_b) =
            if quotient.is_finite() && (1.0 / divisor).is_finite() && (quotient / divisor).is_finite() {
                (value, 1.0 / divisor, -quotient / divisor)
            } else {
                (B::Real::from_f64(0.0), 0.0, 0.0)
            };
        let inner = underflow::<B::Real>(value.to_f64(), a.value.to_f64() != 0.0);
        self.push(Reckoning::Quotient, value, &[(a, by_a), (b, by_b)], inner)
    }

    /// √a of a number that is not negative.
    pub(super) fn sqrt(&mut self, a: Num<B>) -> Num<B> {
        self.root(Reckoning::Root, a)
    }

    /// √a of the square of a half chord.
    pub(super) fn half_root(&mut self, a: Num<B>) -> Num<B> {
        self.root(Reckoning::HalfChord, a)
    }

    fn root(&mut self, step: Reckoning, a: Num<B>) -> Num<B> {
        let value = a.value.sqrt();
        let root = value.to_f64();
        let partial = if root > 0.0 { 0.5 / root } else { 0.0 };
        self.push(step, value, &[(a, partial)], 0.0)
    }

    /// a·b + c·d.
    pub(super) fn dot(&mut self, a: Num<B>, b: Num<B>, c: Num<B>, d: Num<B>) -> Num<B> {
        let (ab, cd) = (a.value * b.value, c.value * d.value);
        let parts =
            [(a, b.value.to_f64()), (b, a.value.to_f64()), (c, d.value.to_f64()), (d, c.value.to_f64())];
        let inner = of_products::<B::Real, _>(ab.to_f64(), cd.to_f64(), &parts);
        self.push(Reckoning::Dot, ab + cd, &parts, inner)
    }

    /// a·b − c·d.
    pub(super) fn cross(&mut self, a: Num<B>, b: Num<B>, c: Num<B>, d: Num<B>) -> Num<B> {
        let (ab, cd) = (a.value * b.value, c.value * d.value);
        let parts =
            [(a, b.value.to_f64()), (b, a.value.to_f64()), (c, -d.value.to_f64()), (d, -c.value.to_f64())];
        let inner = of_products::<B::Real, _>(ab.to_f64(), cd.to_f64(), &parts);
        self.push(Reckoning::Cross, ab - cd, &parts, inner)
    }

    /// Cosine and sine of an angle in radians.
    pub(super) fn cos_sin(&mut self, angle: Num<B>) -> [Num<B>; 2] {
        let (sin, cos) = angle.value.sin_cos();
        // Along the x-axis sine and cosine are exact.
        let exact = angle.value.to_f64() == 0.0;
        let inner = B::Real::UNIT_ROUNDOFF * B::Real::TRANSCENDENTAL_ULPS;
        let (s, c) = (sin.to_f64(), cos.to_f64());
        if exact {
            let mut along =
                |value, step, by| Num { value, mark: self.recorder.result(step, &[(angle.mark, by)], 0.0) };
            return [along(cos, Reckoning::Cosine, -s), along(sin, Reckoning::Sine, c)];
        }
        let size = |x: f64| inner * x.abs().max(B::Real::SINE_FLOOR);
        let cos = self.push(Reckoning::Cosine, cos, &[(angle, -s)], size(c));
        let sin = self.push(Reckoning::Sine, sin, &[(angle, c)], size(s));
        [cos, sin]
    }

    /// Angle of the vector (x, y) from +x.
    pub(super) fn atan2(&mut self, y: Num<B>, x: Num<B>) -> Num<B> {
        self.angle_of(Reckoning::Angle, y, x)
    }

    /// The same for an angle that goes on beyond half a turn where the drawing is run on.
    pub(super) fn turned_angle(&mut self, y: Num<B>, x: Num<B>) -> Num<B> {
        self.angle_of(Reckoning::Turned, y, x)
    }

    fn angle_of(&mut self, step: Reckoning, y: Num<B>, x: Num<B>) -> Num<B> {
        let value = y.value.atan2(x.value);
        let (fx, fy) = (x.value.to_f64(), y.value.to_f64());
        let square = fx * fx + fy * fy;
        let (by_y, by_x) = if square > 0.0 { (fx / square, -fy / square) } else { (0.0, 0.0) };
        let inner = B::Real::UNIT_ROUNDOFF * B::Real::TRANSCENDENTAL_ULPS * value.to_f64().abs();
        self.push(step, value, &[(y, by_y), (x, by_x)], inner)
    }
}

/// The number, or zero and `false` where the arithmetic has run over.
fn finite<R: Real>(value: R) -> (R, bool) {
    if value.to_f64().is_finite() { (value, true) } else { (R::from_f64(0.0), false) }
}

/// The relative error of a factor that the arithmetic may have to round.
fn factor_error<R: Real>(factor: f64) -> f64 {
    if R::from_f64(factor).to_f64() == factor { 0.0 } else { R::UNIT_ROUNDOFF }
}

/// What a product or quotient may lose below the smallest number with all digits; nothing where a factor
/// is zero.
fn underflow<R: Real>(value: f64, not_zero: bool) -> f64 {
    if not_zero && value.abs() < R::SMALLEST { R::UNDERFLOW } else { 0.0 }
}

/// The roundings of the two products in a sum of them; `parts` holds each factor beside the other.
fn of_products<R: Real, N>(ab: f64, cd: f64, parts: &[(N, f64); 4]) -> f64 {
    R::rounding(ab)
        + R::rounding(cd)
        + underflow::<R>(ab, parts[0].1 != 0.0 && parts[1].1 != 0.0)
        + underflow::<R>(cd, parts[2].1 != 0.0 && parts[3].1 != 0.0)
}

/// The power of two that brings a size to between a half and one; one where there is no size.
pub(super) fn power_of_two(size: f64) -> f64 {
    if !(size.is_normal()) {
        return 1.0;
    }
    let (_, exponent) = libm::frexp(size);
    // Halved, so that neither the factor nor its reciprocal leaves the doubles.
    libm::ldexp(1.0, (-exponent).clamp(-500, 500))
}
