//! Scalar reckoning on the tape: each operation writes its partial derivatives and its own rounding.

use super::scalar::Real;
use super::tape::{Reason, Recorder};
use super::{Bench, Board, Num};
use crate::given::Given;

impl<B: Bench> Board<B> {
    /// A number of the scene, with its uncertainty.
    pub fn given(&mut self, given: Given) -> Num<B> {
        let value = B::Real::from_f64(given.value);
        Num { value, mark: self.recorder.given(given.error) }
    }

    /// An exact number.
    pub fn exact(&mut self, value: f64) -> Num<B> {
        self.given(Given::exact(value))
    }

    fn push(&mut self, value: B::Real, parts: &[(Num<B>, f64)], inner: f64) -> Num<B> {
        let rounding = inner + value.to_f64().abs() * B::Real::UNIT_ROUNDOFF;
        let mut marks = [(Default::default(), 0.0); 4];
        for (to, (num, partial)) in marks.iter_mut().zip(parts) {
            *to = (num.mark, *partial);
        }
        Num { value, mark: self.recorder.result(&marks[..parts.len().min(4)], rounding) }
    }

    pub(super) fn add(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        self.push(a.value + b.value, &[(a, 1.0), (b, 1.0)], 0.0)
    }

    pub(super) fn sub(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        self.push(a.value - b.value, &[(a, 1.0), (b, -1.0)], 0.0)
    }

    /// −a, exact.
    pub(super) fn neg(&mut self, a: Num<B>) -> Num<B> {
        Num { value: -a.value, mark: self.recorder.result(&[(a.mark, -1.0)], 0.0) }
    }

    pub(super) fn mul(&mut self, a: Num<B>, b: Num<B>) -> Num<B> {
        self.push(a.value * b.value, &[(a, b.value.to_f64()), (b, a.value.to_f64())], 0.0)
    }

    /// a · factor for an exact factor.
    pub(super) fn times(&mut self, a: Num<B>, factor: f64) -> Num<B> {
        self.push(a.value * B::Real::from_f64(factor), &[(a, factor)], 0.0)
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
        self.push(value, &[(a, by_a), (b, by_b)], 0.0)
    }

    /// √a of a number that is not negative.
    pub(super) fn sqrt(&mut self, a: Num<B>) -> Num<B> {
        let value = a.value.sqrt();
        let root = value.to_f64();
        let partial = if root > 0.0 { 0.5 / root } else { 0.0 };
        self.push(value, &[(a, partial)], 0.0)
    }

    /// a·b + c·d.
    pub(super) fn dot(&mut self, a: Num<B>, b: Num<B>, c: Num<B>, d: Num<B>) -> Num<B> {
        let (ab, cd) = (a.value * b.value, c.value * d.value);
        let inner = B::Real::UNIT_ROUNDOFF * (ab.to_f64().abs() + cd.to_f64().abs());
        let parts =
            [(a, b.value.to_f64()), (b, a.value.to_f64()), (c, d.value.to_f64()), (d, c.value.to_f64())];
        self.push(ab + cd, &parts, inner)
    }

    /// a·b − c·d.
    pub(super) fn cross(&mut self, a: Num<B>, b: Num<B>, c: Num<B>, d: Num<B>) -> Num<B> {
        let (ab, cd) = (a.value * b.value, c.value * d.value);
        let inner = B::Real::UNIT_ROUNDOFF * (ab.to_f64().abs() + cd.to_f64().abs());
        let parts =
            [(a, b.value.to_f64()), (b, a.value.to_f64()), (c, -d.value.to_f64()), (d, -c.value.to_f64())];
        self.push(ab - cd, &parts, inner)
    }

    /// Cosine and sine of an angle in radians.
    pub(super) fn cos_sin(&mut self, angle: Num<B>) -> [Num<B>; 2] {
        let (sin, cos) = angle.value.sin_cos();
        // Along the x-axis sine and cosine are exact.
        let exact = angle.value.to_f64() == 0.0;
        let inner = B::Real::UNIT_ROUNDOFF * B::Real::TRANSCENDENTAL_ULPS;
        let (s, c) = (sin.to_f64(), cos.to_f64());
        if exact {
            let along =
                |d: &mut Self, value, by| Num { value, mark: d.recorder.result(&[(angle.mark, by)], 0.0) };
            return [along(self, cos, -s), along(self, sin, c)];
        }
        let cos = self.push(cos, &[(angle, -s)], inner * c.abs());
        let sin = self.push(sin, &[(angle, c)], inner * s.abs());
        [cos, sin]
    }

    /// Angle of the vector (x, y) from +x.
    pub(super) fn atan2(&mut self, y: Num<B>, x: Num<B>) -> Num<B> {
        let value = y.value.atan2(x.value);
        let (fx, fy) = (x.value.to_f64(), y.value.to_f64());
        let square = fx * fx + fy * fy;
        let (by_y, by_x) = if square > 0.0 { (fx / square, -fy / square) } else { (0.0, 0.0) };
        let inner = B::Real::UNIT_ROUNDOFF * B::Real::TRANSCENDENTAL_ULPS * value.to_f64().abs();
        self.push(value, &[(y, by_y), (x, by_x)], inner)
    }
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
