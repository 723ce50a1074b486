//! Numbers that change with the angle of the input: tables and harmonics, as they were given.

use super::Given;

/// A size over the angle of the first input, in SI units and radians.
#[derive(Debug, Clone, PartialEq)]
pub enum Curve {
    /// Straight from knot to knot, and from the last one on to the first one of the next period.
    Table {
        /// Angle and size, ascending by angle; where an angle stands twice the curve leaps.
        knots: Vec<[Given; 2]>,
        /// After which angle it comes again, radians.
        period: Given,
    },
    /// A constant with sines and cosines of multiples of the angle.
    Harmonics {
        /// What is there without them.
        constant: Given,
        /// The sines.
        sin: Vec<Harmonic>,
        /// The cosines.
        cos: Vec<Harmonic>,
    },
}

/// One sine or cosine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Harmonic {
    /// How many waves there are in a turn of the input: whole or half.
    pub order: Given,
    /// The largest value.
    pub size: Given,
}
