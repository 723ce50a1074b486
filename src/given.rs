//! Numbers as they were stated: a value and what the statement leaves open.

use crate::double_double::DoubleDouble;

/// Half a unit in the last place of a double, relative.
const HALF_ULP: f64 = f64::EPSILON / 2.0;

/// A number somebody stated, in SI units, with the radius of what the statement can mean.
///
/// `error` is at least half a unit in the last place of the number as read, plus the rounding of the
/// unit conversion: the true value lies within `value ± error`. To an arithmetic finer than a double, the
/// same statement is `value + low`, within `low_error`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Given {
    /// The number in SI units (m, rad, s).
    pub value: f64,
    /// Radius of uncertainty in the same unit; never negative.
    pub error: f64,
    /// What the nearest double leaves of the number.
    pub low: f64,
    /// Radius of uncertainty of `value + low`; never negative.
    pub low_error: f64,
}

impl Given {
    /// A number that is exact by definition (a default of zero, a fixed origin).
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0, low: 0.0, low_error: 0.0 }
    }

    /// A number known within a radius, whatever the arithmetic.
    #[must_use]
    pub const fn within(value: f64, error: f64) -> Self {
        Self { value, error, low: 0.0, low_error: error }
    }

    /// The same number, known less well by so much.
    #[must_use]
    pub fn with_room(self, room: f64) -> Self {
        Self { error: self.error + room, low_error: self.low_error + room, ..self }
    }

    /// A number read as a double: half a unit in its last place.
    #[must_use]
    pub fn read(value: f64) -> Self {
        Self::within(value, value.abs() * HALF_ULP)
    }

    /// A number read from decimal text: half a unit in the last place of the arithmetic that takes it.
    /// `None` where the text is no number; infinite and vanished numbers are the caller's to refuse.
    #[must_use]
    pub fn decimal(text: &str) -> Option<Self> {
        let value: f64 = text.parse().ok()?;
        Some(match DoubleDouble::parse(text) {
            Some(fine) => {
                let mut given = Self::fine(fine, value.abs() * 8.0 * DoubleDouble::ROUNDOFF);
                // The double that everybody reads, also where the text lies halfway between two.
                given.low += given.value - value;
                given.value = value;
                given.error = value.abs() * HALF_ULP;
                given
            }
            None => Self::read(value),
        })
    }

    /// A number known as a double-double within `low_error`.
    #[must_use]
    pub fn fine(fine: DoubleDouble, low_error: f64) -> Self {
        Self { value: fine.hi(), error: fine.lo().abs() + low_error, low: fine.lo(), low_error }
    }

    /// The number as a double-double.
    #[must_use]
    pub fn double_double(self) -> DoubleDouble {
        DoubleDouble::sum(self.value, self.low)
    }

    /// The number in another unit: `value × factor` for an exact factor.
    #[must_use]
    pub fn times(self, factor: f64) -> Self {
        let value = self.value * factor;
        let fine = self.double_double() * DoubleDouble::of(factor);
        // A product with ½ or 2 is exact; any other rounds.
        let exact = factor.abs() == 1.0 || factor.abs() == 0.5 || factor.abs() == 2.0;
        let (rounding, fine_rounding) = if exact { (0.0, 0.0) } else { (HALF_ULP, DoubleDouble::ROUNDOFF) };
        Self {
            value,
            error: self.error * factor.abs() + value.abs() * rounding,
            low: fine.hi() - value + fine.lo(),
            low_error: self.low_error * factor.abs() + value.abs() * fine_rounding,
        }
    }
}

impl std::ops::Neg for Given {
    type Output = Self;

    fn neg(self) -> Self {
        // Written so that zero stays the positive one.
        Self { value: 0.0 - self.value, low: 0.0 - self.low, ..self }
    }
}
