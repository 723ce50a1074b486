//! The arithmetic in which the board reckons.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A real number of some precision. Every operation is correctly rounded, or its error is stated.
pub trait Real:
    Copy
    + Debug
    + PartialOrd
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// Unit roundoff: a correctly rounded operation errs by at most this times its result.
    const UNIT_ROUNDOFF: f64;
    /// Relative error of [`Real::sin_cos`] and [`Real::atan2`], in unit roundoffs.
    const TRANSCENDENTAL_ULPS: f64;
    /// Nearest number.
    fn from_f64(value: f64) -> Self;
    /// Nearest double.
    fn to_f64(self) -> f64;
    /// Square root; of a negative number, zero.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Angle of the vector (x, self) from +x in (−π, π].
    fn atan2(self, x: Self) -> Self;
}

impl Real for f64 {
    const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
    // libm's sin, cos and atan2 state less than one unit in the last place, which is two roundoffs.
    const TRANSCENDENTAL_ULPS: f64 = 2.0;

    fn from_f64(value: f64) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn sqrt(self) -> Self {
        if self > 0.0 { f64::sqrt(self) } else { 0.0 }
    }

    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }

    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
}
