//! Values that more than one command takes as an argument.

use crate::solve::{Arithmetic, Hand};
use crate::sweep::Over;

/// What a sweep goes over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Against {
    Input,
    Time,
}

impl Against {
    pub(super) const fn over(self) -> Over {
        match self {
            Self::Input => Over::Input,
            Self::Time => Over::Time,
        }
    }
}

pub(super) fn arithmetic(text: &str) -> Result<Arithmetic, String> {
    match text {
        "f32" => Ok(Arithmetic::Single),
        "f64" => Ok(Arithmetic::Double),
        "dd" => Ok(Arithmetic::DoubleDouble),
        _ => Err("expected f32, f64 or dd".to_owned()),
    }
}

/// `0.2mm,0.3deg`, with or without the units.
pub(super) fn hand(text: &str) -> Result<Hand, String> {
    let wrong = || "expected a slip in millimetres and one in degrees, such as 0.2mm,0.3deg".to_owned();
    let (length, angle) = text.split_once(',').ok_or_else(wrong)?;
    let part = |text: &str, unit: &str, most: f64| {
        let text = text.trim();
        let digits = text.strip_suffix(unit).unwrap_or(text).trim_end();
        match digits.parse::<f64>() {
            Ok(value) if (0.0..=most).contains(&value) => Ok(value),
            Ok(_) => Err(format!("a hand slips by 0 to {most} {unit}")),
            Err(_) => Err(wrong()),
        }
    };
    Ok(Hand { length: part(length, "mm", 10.0)?, angle: part(angle, "deg", 10.0)?.to_radians() })
}

/// `15deg`, with or without the unit; radians.
pub(super) fn crossing(text: &str) -> Result<f64, String> {
    match text.trim().trim_end_matches("deg").trim_end().parse::<f64>() {
        // Beyond it hardly a scene has all its crossings.
        Ok(degrees) if (0.0..=60.0).contains(&degrees) => Ok(degrees.to_radians()),
        _ => Err("expected an angle from 0deg to 60deg, such as 15deg".to_owned()),
    }
}

pub(super) fn percent(text: &str) -> Result<f64, String> {
    let (number, factor) = match text.trim().strip_suffix('%') {
        Some(number) => (number, 0.01),
        None => (text, 1.0),
    };
    match number.trim().parse::<f64>() {
        // A bare 5 would be 500 %, which nobody means.
        Ok(value) if (0.0..=1.0).contains(&(value * factor)) => Ok(value * factor),
        _ => Err("expected a percentage up to 100% such as 5%, or a part such as 0.05".to_owned()),
    }
}

/// A tolerance of sampling.
pub(super) fn straying(text: &str) -> Result<f64, String> {
    match percent(text)? {
        // Straight lines come so near with some hundred thousand positions; nearer a table is no help.
        part if part < LEAST_STRAYING => {
            Err("the least tolerance is 1e-7%; for more positions give --steps".to_owned())
        }
        part => Ok(part),
    }
}

/// The least tolerance of sampling, as a part of a column's range.
const LEAST_STRAYING: f64 = 1e-9;

pub(super) fn place(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(place) if place.is_finite() => Ok(place),
        _ => Err("expected a number, in the scene's unit of the input".to_owned()),
    }
}
