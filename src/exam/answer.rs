//! The numbers that a student hands in, and how far they may be off.

use crate::graphical::construction::Construction;
use crate::mechanism::force::{Action, Force, Through};
use crate::mechanism::quantity::{Answer, Asked, Nature, Quantity};
use crate::mechanism::{LinkId, Path, Rider};
use crate::scene::Scene;
use crate::sheet::{Marked, Part};
use crate::tolerance::{Allowance, Room, is_place};

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
    /// What a careful hand may be off, where that is more than is allowed.
    pub loose: Option<f64>,
    /// What it is worth.
    pub weight: f64,
    /// Whether its sign is a sense of rotation.
    pub turns: bool,
}

/// A number is printed to so many figures of its tolerance.
const FIGURES: i32 = 3;

/// Of what a vector is worth so much is its direction where only its sense is left to choose.
const SENSE: f64 = 0.25;
/// Who has a rotation with the wrong sense has so much of it right, percent.
pub(super) const WITHOUT_SENSE: f64 = 75.0;

impl KeyAnswer {
    /// The number as it is printed: two figures finer than its tolerance, so that what is printed accepts what is right.
    #[must_use]
    pub fn printed(&self) -> String {
        fixed(self.value, self.tolerance, FIGURES)
    }

    /// The tolerance as it is printed.
    #[must_use]
    pub fn printed_tolerance(&self) -> String {
        fixed(self.tolerance, self.tolerance, 2)
    }

    /// Every way to write the right number: a direction is the same a turn later or earlier, so that within its
    /// tolerance 359.5° is 0° and −180° is 180°.
    #[must_use]
    pub fn spellings(&self) -> Vec<String> {
        let mut all = vec![self.printed()];
        if self.part == Part::Direction {
            all.extend([360.0, -360.0].map(|turn| fixed(self.value + turn, self.tolerance, FIGURES)));
        }
        all
    }

    /// The same number with the opposite sense, where it is a rotation that has one.
    #[must_use]
    pub fn opposite(&self) -> Option<String> {
        (self.turns && self.value.abs() > 2.0 * self.tolerance)
            .then(|| fixed(-self.value, self.tolerance, FIGURES))
    }

    /// Whether another variant's number could pass for this one.
    pub(super) fn alike(&self, other: &Self) -> bool {
        let apart = (self.value - other.value).abs();
        let apart = if self.part == Part::Direction { apart.min((360.0 - apart).abs()) } else { apart };
        apart <= self.tolerance.max(other.tolerance)
    }
}

/// A number with so many figures of its tolerance.
pub(super) fn fixed(value: f64, tolerance: f64, figures: i32) -> String {
    let first = if tolerance > 0.0 { libm::floor(libm::log10(tolerance)) as i32 } else { -6 };
    let decimals = (figures - 1 - first).clamp(0, 17) as usize;
    let text = format!("{value:.decimals$}");
    let text = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if text == "-0" { "0".to_owned() } else { text.to_owned() }
}

/// What the numbers of an answer depend on besides their values.
#[derive(Debug, Clone, Copy)]
pub(super) struct Worth {
    /// The marks that the scene states for it.
    pub(super) marks: Option<f64>,
    /// Its direction is given but for its sense.
    pub(super) along_guide: bool,
}

impl Worth {
    pub(super) fn of(scene: &Scene, asked: &Asked) -> Self {
        let marks = scene.sheet.marks.iter().find(|(name, _)| *name == asked.name).map(|(_, marks)| *marks);
        Self { marks, along_guide: along_guide(scene, asked.quantity) }
    }
}

/// Which part of its marks an answer has whose magnitude is right and of which nothing is said about sense or direction.
/// A rotation without a sense is counter-clockwise, as the questions say.
pub(crate) fn share_without_direction(scene: &Scene, quantity: Quantity, right: &[f64]) -> f64 {
    match (quantity, right) {
        (Quantity::Position(_) | Quantity::Centre(..), _) => 1.0,
        (_, [x, y]) if *x != 0.0 || *y != 0.0 => 1.0 - direction_part(scene, quantity),
        (quantity, [value]) if quantity.nature() == Nature::Rotation && *value < 0.0 => WITHOUT_SENSE / 100.0,
        _ => 1.0,
    }
}

/// Which part of its marks a number has that has the right size and the other sense; none where it has no sense.
pub(crate) fn share_of_opposite(quantity: Quantity) -> f64 {
    if quantity.nature() == Nature::Rotation { WITHOUT_SENSE / 100.0 } else { 0.0 }
}

/// Which part of a vector's marks its direction has.
fn direction_part(scene: &Scene, quantity: Quantity) -> f64 {
    if along_guide(scene, quantity) { SENSE } else { 0.5 }
}

/// Whether the direction of a vector is given but for its sense: by a fixed straight guide.
fn along_guide(scene: &Scene, quantity: Quantity) -> bool {
    if let Quantity::Force(Force::Vector(Action::Pair { by, on }), _) = quantity {
        return presses_square(scene, by, on);
    }
    let (Quantity::Velocity(point) | Quantity::Acceleration(point)) = quantity else { return false };
    scene.mechanism.slides.iter().any(|slide| {
        let rides = matches!(slide.rider, Rider::Pin { point: rider, .. } if rider == point);
        let straight = matches!(slide.guide.path, Path::Straight { .. });
        rides && straight && slide.guide.link == LinkId::FRAME
    })
}

/// Whether the only pair of two links is a straight guide on the frame that does not rub: its force is square to it.
fn presses_square(scene: &Scene, by: LinkId, on: LinkId) -> bool {
    let mechanism = &scene.mechanism;
    let [Through::Slide(index)] = mechanism.pairs_between(by, on)[..] else { return false };
    let guide = mechanism.slides[index].guide;
    let straight = matches!(guide.path, Path::Straight { .. });
    straight && guide.link == LinkId::FRAME && mechanism.forces.friction.resistance(index).is_none()
}

/// Whether the sign of a number is a sense of rotation.
fn turns(asked: &Asked) -> bool {
    match asked.quantity {
        Quantity::Force(force, _) => force.turns(),
        Quantity::Cycle(_) => false,
        _ => asked.unit.symbol.starts_with("rad/") || asked.unit.symbol.starts_with("rpm"),
    }
}

/// The numbers of an answer; none where it has no number or cannot be drawn by hand.
pub(super) fn numbers(
    index: usize,
    asked: &Asked,
    answer: &Answer,
    allowed: Option<&Allowance>,
    worth: Worth,
) -> Vec<KeyAnswer> {
    let Some(allowed) = allowed else { return Vec::new() };
    let number = |part, unit: &str, (value, si): (f64, f64), room: Room, weight: f64| KeyAnswer {
        name: asked.name.clone(),
        asked: index,
        part,
        unit: unit.to_owned(),
        value: value / si,
        tolerance: room.by / si,
        loose: room.loose.then_some(room.honest / si),
        weight,
        turns: part == Part::Value && turns(asked),
    };
    let in_unit = |part, value: f64, weight: f64| {
        number(part, &asked.unit.symbol, (value, asked.unit.si), allowed.size, weight)
    };
    let whole = worth.marks.unwrap_or(1.0);
    match answer {
        Answer::Scalar { value, .. } => vec![in_unit(Part::Value, *value, whole)],
        Answer::Vector { value: [x, y], .. } => {
            if is_place(&asked.quantity) {
                return vec![in_unit(Part::X, *x, whole / 2.0), in_unit(Part::Y, *y, whole / 2.0)];
            }
            let mut numbers = vec![in_unit(Part::Magnitude, libm::hypot(*x, *y), whole)];
            if let Some(direction) = allowed.direction {
                let part = if worth.along_guide { SENSE } else { 0.5 };
                numbers[0].weight = (1.0 - part) * whole;
                let value = (libm::atan2(*y, *x), 1_f64.to_radians());
                numbers.push(number(Part::Direction, "deg", value, direction, part * whole));
            }
            numbers
        }
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => Vec::new(),
    }
}

/// What each answer of a scene is worth; what lies at infinity is no answer.
pub(super) fn marked(scene: &Scene, construction: &Construction) -> Vec<Marked> {
    let asked = scene.mechanism.asked.iter().zip(&construction.answers);
    let mut all: Vec<Marked> = Vec::new();
    for (asked, reading) in asked {
        let worth = Worth::of(scene, asked);
        let marks = worth.marks.unwrap_or(1.0);
        let direction = match reading.answer {
            Answer::Vector { .. } if !is_place(&asked.quantity) => {
                Some(marks * if worth.along_guide { SENSE } else { 0.5 })
            }
            Answer::Vector { .. } | Answer::Scalar { .. } => None,
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => continue,
        };
        match all.iter_mut().find(|known| known.quantity == asked.quantity) {
            // Asked by several methods: each has its marks.
            Some(known) => {
                known.marks += marks;
                known.direction = known.direction.zip(direction).map(|(one, other)| one + other);
            }
            None => all.push(Marked { quantity: asked.quantity, marks, direction }),
        }
    }
    all
}

/// Whole numbers in the ratio of the weights, as small as they can be; as near as whole numbers come where they are odd.
pub(super) fn whole_weights(weights: &[f64]) -> Vec<u32> {
    let times = |k: u32| weights.iter().map(move |w| w * f64::from(k));
    let whole = |k: &u32| times(*k).all(|w| (w - libm::round(w)).abs() < 1e-6 && w > 0.5);
    let k = (1..=MOST_PARTS).find(whole).unwrap_or(MOST_PARTS);
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "marks are few")]
    times(k).map(|w| libm::round(w).clamp(1.0, 1e6) as u32).collect()
}

/// Marks are told in parts no smaller than this.
const MOST_PARTS: u32 = 24;

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
        KeyAnswer {
            name: "v(B)".to_owned(),
            asked: 0,
            part,
            unit: "deg".to_owned(),
            value,
            tolerance,
            loose: None,
            weight: 1.0,
            turns: false,
        }
    }

    #[test]
    fn numbers_are_printed_finer_than_their_tolerance() {
        let one = answer(Part::Value, 175.309_524_5, 2.34);
        assert_eq!((one.printed().as_str(), one.printed_tolerance().as_str()), ("175.31", "2.3"));
        let one = answer(Part::Value, -0.001_234_56, 0.000_012);
        assert_eq!((one.printed().as_str(), one.printed_tolerance().as_str()), ("-0.0012346", "0.000012"));
        assert_eq!(answer(Part::Value, 1_234_567.0, 5000.0).printed(), "1234567");
    }

    #[test]
    fn a_direction_is_the_same_a_turn_later_and_earlier() {
        assert_eq!(answer(Part::Direction, -10.0, 1.0).spellings(), ["-10", "350", "-370"]);
        assert_eq!(answer(Part::Direction, 170.0, 1.0).spellings(), ["170", "530", "-190"]);
        // 359.5 for 0: within the tolerance of one of them.
        let accepted = |value: f64, given: f64| {
            let key = answer(Part::Direction, value, 0.5);
            key.spellings().iter().any(|s| (s.parse::<f64>().unwrap() - given).abs() <= 0.5)
        };
        assert!(
            accepted(0.0, 359.5) && accepted(0.0, -0.5) && accepted(180.0, -179.6) && !accepted(0.0, 180.0)
        );
        assert!(answer(Part::Direction, 179.5, 1.1).alike(&answer(Part::Direction, -179.5, 1.0)));
        assert!(!answer(Part::Value, 179.5, 1.1).alike(&answer(Part::Value, -179.5, 1.0)));
    }
    #[test]
    fn weights_are_whole_numbers_in_their_ratio() {
        assert_eq!(whole_weights(&[1.0, 1.0]), [1, 1]);
        assert_eq!(whole_weights(&[1.5, 0.5, 1.0]), [3, 1, 2]);
        assert_eq!(whole_weights(&[2.25, 0.75, 1.0]), [9, 3, 4]);
        assert_eq!(whole_weights(&[4.0, 2.0]), [4, 2]);
    }

    #[test]
    fn a_sense_alone_is_worth_less_than_a_magnitude() {
        let mut rate = answer(Part::Value, -5.84, 0.1);
        rate.turns = true;
        assert_eq!(rate.opposite().as_deref(), Some("5.84"));
        rate.tolerance = 3.0;
        assert_eq!(rate.opposite(), None);
        assert_eq!(answer(Part::Direction, -5.84, 0.1).opposite(), None);
    }
}
