//! Answers to another variant of an exam: copied from a neighbour, or handed in under the wrong number.

use serde_json::Value;

use super::answers::{Answers, Given, Item};

/// The numbers of every variant of an exam, as its key has them.
#[derive(Debug, Clone, Default)]
pub struct Key {
    variants: Vec<(String, Vec<KeyNumber>)>,
}

/// One number of a variant.
#[derive(Debug, Clone)]
struct KeyNumber {
    quantity: String,
    part: String,
    /// In its unit, degrees of a direction; so is the tolerance.
    value: f64,
    tolerance: f64,
}

/// So many numbers at least are those of the other variant and not of the own one.
const LEAST: usize = 3;

impl Key {
    /// Reads the `key.json` of an exam; `None` where it is none.
    #[must_use]
    pub fn read(text: &str) -> Option<Self> {
        let key: Value = serde_json::from_str(text).ok()?;
        let number = |answer: &Value| {
            Some(KeyNumber {
                quantity: answer["quantity"].as_str()?.to_owned(),
                part: answer["part"].as_str()?.to_owned(),
                value: answer["answer"].as_f64()?,
                tolerance: answer["tolerance"].as_f64()?,
            })
        };
        let variant = |variant: &Value| {
            let numbers: Option<Vec<KeyNumber>> = variant["answers"].as_array()?.iter().map(number).collect();
            Some((variant["variant"].as_str()?.to_owned(), numbers?))
        };
        let variants: Option<Vec<_>> = key["variants"].as_array()?.iter().map(variant).collect();
        Some(Self { variants: variants? })
    }

    /// The other variant to which somebody's answers belong: nine of ten of all numbers that are wrong of his own variant are
    /// right of it, and more of all are than of his own.
    #[must_use]
    pub fn other_variant(&self, answers: &Answers, own: &str) -> Option<String> {
        let right = |numbers: &[KeyNumber]| -> Vec<bool> {
            let of = numbers.iter().filter_map(|number| {
                let item = answers.items.iter().find(|item| item.asked.name == number.quantity)?;
                number.is_met(item)
            });
            of.collect()
        };
        let own_right = right(&self.variants.iter().find(|(name, _)| name == own)?.1);
        let wrong = own_right.iter().filter(|right| !**right).count();
        let others = self.variants.iter().filter(|(name, _)| name != own).filter_map(|(name, numbers)| {
            let theirs = right(numbers);
            if theirs.len() != own_right.len() {
                return None;
            }
            let taken = theirs.iter().zip(&own_right).filter(|(theirs, own)| **theirs && !**own).count();
            let all = theirs.iter().filter(|right| **right).count();
            let more = all > own_right.len() - wrong;
            (more && taken >= LEAST && 10 * taken >= 9 * wrong).then_some((all, name))
        });
        let (most, name) = others.max_by_key(|(all, _)| *all)?;
        // Most of what he hands in is of that variant, not only what one fault has in common with it.
        (10 * most >= 9 * own_right.len()).then(|| name.clone())
    }
}

impl KeyNumber {
    /// Whether an answer has this number; `None` where it does not tell it.
    fn is_met(&self, item: &Item) -> Option<bool> {
        let si = item.asked.unit.si;
        let near = |value: f64| (value / si - self.value).abs() <= self.tolerance;
        match (self.part.as_str(), item.given) {
            ("value", Given::Signed(value)) => Some(near(value)),
            ("value" | "magnitude", Given::Magnitude(size)) => {
                Some((size / si - self.value.abs()).abs() <= self.tolerance)
            }
            ("magnitude", Given::Vector([x, y])) => Some(near(libm::hypot(x, y))),
            ("direction", Given::Vector([x, y])) => {
                let away = libm::atan2(y, x).to_degrees() - self.value;
                Some((away - 360.0 * libm::round(away / 360.0)).abs() <= self.tolerance)
            }
            ("x", Given::Vector([x, _])) => Some(near(x)),
            ("y", Given::Vector([_, y])) => Some(near(y)),
            _ => None,
        }
    }
}
