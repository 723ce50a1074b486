//! The numbers that a student hands in, and how far they may be off.

use crate::graphical::HandError;
use crate::mechanism::quantity::{Answer, Asked, Quantity};
use crate::sheet::Part;

/// Three significant figures are asked for, as on the sheet: a number that is right to them is right.
const THREE_FIGURES: f64 = 0.005;
/// A direction is read to half a degree.
const HALF_DEGREE: f64 = 0.5;

/// One number of the key.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyAnswer {
    /// The asked quantity, as the scene names it.
    pub name: String,
    /// Index of the asked quantity in the scene.
    pub asked: usize,
    /// Which of its numbers.
    pub part: Part,
    /// The unit; degrees for directions.
    pub unit: String,
    /// The right number, in the unit.
    pub value: f64,
    /// By how much an answer may be off, in the unit.
    pub tolerance: f64,
}

impl KeyAnswer {
    /// The number as it is printed: two figures finer than its tolerance.
    #[must_use]
    pub fn printed(&self) -> String {
        fixed(self.value, self.tolerance, 2)
    }

    /// The tolerance as it is printed.
    #[must_use]
    pub fn printed_tolerance(&self) -> String {
        fixed(self.tolerance, self.tolerance, 2)
    }

    /// Every way to write the right number: a direction may be counted from −180° or from 0°.
    #[must_use]
    pub fn spellings(&self) -> Vec<String> {
        let mut all = vec![self.printed()];
        if self.part == Part::Direction {
            let other = if self.value < 0.0 { self.value + 360.0 } else { self.value - 360.0 };
            all.push(fixed(other, self.tolerance, 2));
        }
        all
    }

    /// Whether another variant's number could pass for this one.
    pub(super) fn alike(&self, other: &Self) -> bool {
        let apart = (self.value - other.value).abs();
        let apart = if self.part == Part::Direction { apart.min((360.0 - apart).abs()) } else { apart };
        apart <= self.tolerance.max(other.tolerance)
    }
}

/// A number with so many figures of its tolerance.
fn fixed(value: f64, tolerance: f64, figures: i32) -> String {
    let first = if tolerance > 0.0 { libm::floor(libm::log10(tolerance)) as i32 } else { -6 };
    let decimals = (figures - 1 - first).clamp(0, 17) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// The numbers of an answer; none where it has no number or cannot be drawn by hand.
pub(super) fn numbers(index: usize, asked: &Asked, answer: &Answer, hand: &HandError) -> Vec<KeyAnswer> {
    let Some(slip) = hand.tolerance() else { return Vec::new() };
    let si = asked.unit.si;
    let number = |part, unit: &str, value: f64, tolerance: f64| KeyAnswer {
        name: asked.name.clone(),
        asked: index,
        part,
        unit: unit.to_owned(),
        value,
        tolerance,
    };
    let in_unit = |part, value: f64| {
        let value = value / si;
        number(part, &asked.unit.symbol, value, f64::max(slip / si, THREE_FIGURES * value.abs()))
    };
    match answer {
        Answer::Scalar { value, .. } => vec![in_unit(Part::Value, *value)],
        Answer::Vector { value: [x, y], .. } => {
            if let Quantity::Position(_) | Quantity::Centre(..) = asked.quantity {
                return vec![in_unit(Part::X, *x), in_unit(Part::Y, *y)];
            }
            let size = libm::hypot(*x, *y);
            let turn = libm::asin(if size > slip { slip / size } else { 1.0 }).to_degrees();
            let direction = libm::atan2(*y, *x).to_degrees();
            vec![
                in_unit(Part::Magnitude, size),
                number(Part::Direction, "deg", direction, turn.max(HALF_DEGREE)),
            ]
        }
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => Vec::new(),
    }
}

/// The size of an answer, SI: what its slip is compared with.
pub(super) fn size(answer: &Answer) -> f64 {
    match answer {
        Answer::Scalar { value, .. } => value.abs(),
        Answer::Vector { value: [x, y], .. } => libm::hypot(*x, *y),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn answer(part: Part, value: f64, tolerance: f64) -> KeyAnswer {
        KeyAnswer { name: "v(B)".to_owned(), asked: 0, part, unit: "deg".to_owned(), value, tolerance }
    }

    #[test]
    fn numbers_are_printed_finer_than_their_tolerance() {
        let one = answer(Part::Value, 175.309_524_5, 2.34);
        assert_eq!((one.printed().as_str(), one.printed_tolerance().as_str()), ("175.3", "2.3"));
        let one = answer(Part::Value, -0.001_234_56, 0.000_012);
        assert_eq!((one.printed().as_str(), one.printed_tolerance().as_str()), ("-0.001235", "0.000012"));
        assert_eq!(answer(Part::Value, 1_234_567.0, 5000.0).printed(), "1234567");
    }

    #[test]
    fn a_direction_has_two_spellings_and_wraps() {
        assert_eq!(answer(Part::Direction, -10.0, 1.0).spellings(), ["-10", "350"]);
        assert_eq!(answer(Part::Direction, 170.0, 1.0).spellings(), ["170", "-190"]);
        assert!(answer(Part::Direction, 179.5, 1.1).alike(&answer(Part::Direction, -179.5, 1.0)));
        assert!(!answer(Part::Value, 179.5, 1.1).alike(&answer(Part::Value, -179.5, 1.0)));
    }
}
