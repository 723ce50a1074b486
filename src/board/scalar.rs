//! The arithmetic in which the board computes.

use std::fmt::Debug;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::double_double::DoubleDouble;
use crate::given::Given;
use crate::wide::Wide;

/// The arithmetics that a board can compute in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Arithmetic {
    /// Single precision, about 7 digits.
    Single,
    /// Double precision, about 16 digits.
    #[default]
    Double,
    /// Double-double, about 31 digits.
    DoubleDouble,
    /// About 75 digits: the reference against which the others are measured.
    Wide,
}

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
    /// Which arithmetic it is.
    const ARITHMETIC: Arithmetic;
    /// Unit roundoff: a correctly rounded operation errs by at most this times its result.
    const UNIT_ROUNDOFF: f64;
    /// Error of [`Real::sin_cos`] and [`Real::atan2`] in unit roundoffs of the result.
    const TRANSCENDENTAL_ULPS: f64;
    /// A sine or cosine smaller than this errs as if it were this large.
    const SINE_FLOOR: f64;
    /// Products and quotients below this may lose digits to underflow.
    const SMALLEST: f64;
    /// How much a product or quotient below [`Real::SMALLEST`] may err absolutely.
    const UNDERFLOW: f64;
    /// What rounding may have done to a result of this size.
    #[must_use]
    fn rounding(value: f64) -> f64 {
        value.abs() * Self::UNIT_ROUNDOFF
    }
    /// What rounding has done to the sum of two numbers, or may have done.
    #[must_use]
    fn rounding_of_sum(_: Self, _: Self, sum: Self) -> f64 {
        Self::rounding(sum.to_f64())
    }
    /// Nearest number.
    fn from_f64(value: f64) -> Self;
    /// Nearest number to one that was stated, and the radius within which that is true.
    fn from_given(given: Given) -> (Self, f64);
    /// Nearest number to a double-double.
    fn from_double_double(value: DoubleDouble) -> Self {
        Self::from_f64(value.hi()) + Self::from_f64(value.lo())
    }
    /// Nearest number to one of 75 digits.
    fn from_wide(value: Wide) -> Self {
        Self::from_double_double(value.to_double_double())
    }
    /// Nearest double.
    fn to_f64(self) -> f64;
    /// The number as a double-double: exactly.
    fn to_double_double(self) -> DoubleDouble;
    /// Square root; of a negative number, zero.
    fn sqrt(self) -> Self;
    /// Sine and cosine of an angle in radians.
    fn sin_cos(self) -> (Self, Self);
    /// Sine of an angle in radians.
    fn sin(self) -> Self {
        self.sin_cos().0
    }
    /// Cosine of an angle in radians.
    fn cos(self) -> Self {
        self.sin_cos().1
    }
    /// Angle of the vector (x, self) from +x in (−π, π].
    fn atan2(self, x: Self) -> Self;
}

/// The highest power of two that is not above a number's size: half a unit in the last place is a unit roundoff
/// of this. Zero for numbers so small that they have no more digits to lose than underflow takes.
fn power_of_two_below(value: f64) -> f64 {
    const EXPONENT: u64 = 0x7ff0_0000_0000_0000;
    f64::from_bits(value.to_bits() & EXPONENT)
}

impl Real for f64 {
    const ARITHMETIC: Arithmetic = Arithmetic::Double;
    const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;
    // libm's sin, cos and atan2 state less than one unit in the last place, which is two roundoffs.
    const TRANSCENDENTAL_ULPS: f64 = 2.0;
    const SINE_FLOOR: f64 = 0.0;
    const SMALLEST: f64 = f64::MIN_POSITIVE;
    const UNDERFLOW: f64 = f64::MIN_POSITIVE * f64::EPSILON;

    fn rounding(value: f64) -> f64 {
        power_of_two_below(value) * Self::UNIT_ROUNDOFF
    }

    fn rounding_of_sum(a: Self, b: Self, sum: Self) -> f64 {
        // What a sum loses is itself a number (O. Møller, 1965; D. E. Knuth's TwoSum).
        let of_b = sum - a;
        let lost = (a - (sum - of_b)) + (b - of_b);
        if lost.is_finite() { lost.abs() } else { Self::rounding(sum.to_f64()) }
    }

    fn from_f64(value: f64) -> Self {
        value
    }

    fn from_given(given: Given) -> (Self, f64) {
        (given.value, given.error)
    }

    fn to_f64(self) -> f64 {
        self
    }

    fn to_double_double(self) -> DoubleDouble {
        DoubleDouble::of(self)
    }

    fn sqrt(self) -> Self {
        if self > 0.0 { f64::sqrt(self) } else { 0.0 }
    }

    fn sin_cos(self) -> (Self, Self) {
        libm::sincos(self)
    }

    fn sin(self) -> Self {
        libm::sin(self)
    }

    fn cos(self) -> Self {
        libm::cos(self)
    }

    fn atan2(self, x: Self) -> Self {
        libm::atan2(self, x)
    }
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to single precision is what is asked for")]
impl Real for f32 {
    const ARITHMETIC: Arithmetic = Arithmetic::Single;
    const UNIT_ROUNDOFF: f64 = f32::EPSILON as f64 / 2.0;
    // As for doubles.
    const TRANSCENDENTAL_ULPS: f64 = 2.0;
    const SINE_FLOOR: f64 = 0.0;
    const SMALLEST: f64 = f32::MIN_POSITIVE as f64;
    const UNDERFLOW: f64 = f32::MIN_POSITIVE as f64 * f32::EPSILON as f64;

    fn rounding(value: f64) -> f64 {
        power_of_two_below(value) * Self::UNIT_ROUNDOFF
    }

    fn rounding_of_sum(a: Self, b: Self, sum: Self) -> f64 {
        // What a sum loses is itself a number (O. Møller, 1965; D. E. Knuth's TwoSum).
        let of_b = sum - a;
        let lost = (a - (sum - of_b)) + (b - of_b);
        if lost.is_finite() { f64::from(lost.abs()) } else { Self::rounding(sum.to_f64()) }
    }

    fn from_f64(value: f64) -> Self {
        value as f32
    }

    fn from_given(given: Given) -> (Self, f64) {
        let value = given.value as f32;
        (value, given.error + (f64::from(value) - given.value).abs())
    }

    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    fn to_double_double(self) -> DoubleDouble {
        DoubleDouble::of(f64::from(self))
    }

    fn sqrt(self) -> Self {
        if self > 0.0 { f32::sqrt(self) } else { 0.0 }
    }

    fn sin_cos(self) -> (Self, Self) {
        libm::sincosf(self)
    }

    fn atan2(self, x: Self) -> Self {
        libm::atan2f(self, x)
    }
}

impl Real for DoubleDouble {
    const ARITHMETIC: Arithmetic = Arithmetic::DoubleDouble;
    const UNIT_ROUNDOFF: f64 = DoubleDouble::ROUNDOFF;
    const TRANSCENDENTAL_ULPS: f64 = 8.0;
    const SINE_FLOOR: f64 = 1.0;
    // The error of a product is lost when it falls below the smallest double.
    const SMALLEST: f64 = f64::MIN_POSITIVE / (f64::EPSILON * f64::EPSILON);
    const UNDERFLOW: f64 = 8.0 * f64::MIN_POSITIVE;

    fn from_f64(value: f64) -> Self {
        Self::of(value)
    }

    fn from_given(given: Given) -> (Self, f64) {
        (given.double_double(), given.low_error)
    }

    fn from_double_double(value: DoubleDouble) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        self.hi()
    }

    fn to_double_double(self) -> DoubleDouble {
        self
    }

    fn sqrt(self) -> Self {
        DoubleDouble::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        DoubleDouble::sin_cos(self)
    }

    fn atan2(self, x: Self) -> Self {
        DoubleDouble::atan2(self, x)
    }
}

/// The reference: it takes a scene's numbers as the double-double arithmetic reads them, for exact.
impl Real for Wide {
    const ARITHMETIC: Arithmetic = Arithmetic::Wide;
    const UNIT_ROUNDOFF: f64 = Wide::ROUNDOFF;
    const TRANSCENDENTAL_ULPS: f64 = 8.0;
    const SINE_FLOOR: f64 = 1.0;
    // The bounds themselves are doubles.
    const SMALLEST: f64 = 0.0;
    const UNDERFLOW: f64 = 0.0;

    fn from_f64(value: f64) -> Self {
        Self::of(value)
    }

    fn from_given(given: Given) -> (Self, f64) {
        (Self::of(given.value) + Self::of(given.low), 0.0)
    }

    fn from_wide(value: Wide) -> Self {
        value
    }

    fn to_f64(self) -> f64 {
        Wide::to_f64(self)
    }

    fn to_double_double(self) -> DoubleDouble {
        Wide::to_double_double(self)
    }

    fn sqrt(self) -> Self {
        Wide::sqrt(self)
    }

    fn sin_cos(self) -> (Self, Self) {
        Wide::sin_cos(self)
    }

    fn atan2(self, x: Self) -> Self {
        Wide::atan2(self, x)
    }
}
