//! Numbers as they were stated: a value and what the statement leaves open.

/// A number somebody stated, in SI units, with the radius of what the statement can mean.
///
/// `error` is at least half a unit in the last place of the number as read, plus the rounding of the
/// unit conversion: the true value lies within `value ± error`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Given {
    /// The number in SI units (m, rad, s).
    pub value: f64,
    /// Radius of uncertainty in the same unit; never negative.
    pub error: f64,
}

impl Given {
    /// A number that is exact by definition (a default of zero, a fixed origin).
    #[must_use]
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0 }
    }

    /// A number read from decimal text: half a unit in its last place.
    #[must_use]
    pub fn read(value: f64) -> Self {
        Self { value, error: value.abs() * (f64::EPSILON / 2.0) }
    }

    /// The number in another unit: `value × factor`, with one rounding for the product and
    /// `factor_error` (relative) for the factor itself.
    #[must_use]
    pub fn scaled(self, factor: f64, factor_error: f64) -> Self {
        let value = self.value * factor;
        let rounding = if factor == 1.0 { 0.0 } else { f64::EPSILON / 2.0 };
        Self { value, error: self.error * factor.abs() + value.abs() * (rounding + factor_error) }
    }
}
