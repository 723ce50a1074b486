//! What is to be entered for an asked quantity where answers are numbers: in examinations that a machine marks.

use super::notation::Notation;
use super::rich::Rich;
use super::words::{Language, Words};
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Asked, Nature, Quantity};
use crate::mechanism::{LinkId, PointId};
use crate::scene::Scene;

/// One number of an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// A scalar; of rotations counter-clockwise positive.
    Value,
    /// Size of a vector.
    Magnitude,
    /// Direction of a vector, degrees counter-clockwise from +x.
    Direction,
    /// x of a place.
    X,
    /// y of a place.
    Y,
}

impl Part {
    /// Its name in tables.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Value => "value",
            Self::Magnitude => "magnitude",
            Self::Direction => "direction",
            Self::X => "x",
            Self::Y => "y",
        }
    }
}

/// What one number of an answer is, in words and with the symbol of the sheet, as hypertext.
#[must_use]
pub fn prompt(scene: &Scene, asked: &Asked, part: Part, language: Language) -> String {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let symbol = notation.symbol(asked.quantity, false).html();
    let symbol = format!("<bdi dir=\"ltr\">{symbol}</bdi>");
    let prompt = prompt_words(words, asked, part).replace("{symbol}", &symbol).replace("{axis}", part.name());
    // A direction stands beside its magnitude.
    match whose(&notation, asked.quantity).filter(|_| part != Part::Direction) {
        Some((_, whose)) => format!("{prompt} ({})", whose.html()),
        None => prompt,
    }
}

/// Of which body a force is and on which it acts, on which body a torque: its sense hangs on it. With the whole of which an
/// asked part is. `None` of what acts on one body alone, which its symbol names, and of what is no force.
pub(super) fn whose(notation: &Notation<'_>, quantity: Quantity) -> Option<(Force, Rich)> {
    let Quantity::Force(force, _) = quantity else { return None };
    let words = notation.words;
    let link = |link: LinkId| Rich::fill(words.link, &[("links", Rich::upright(notation.number(link)))]);
    let pin = |point: PointId| Rich::fill(words.pin_named, &[("point", notation.point(point))]);
    let of_on = |by: Rich, on: Rich| Rich::fill(words.force_of_on, &[("by", by), ("on", on)]);
    let torque = |on: LinkId| Rich::fill(words.torque_on, &[("on", link(on))]);
    Some(match force {
        Force::Along { by, on, .. } | Force::Across { by, on, .. } => {
            (Force::Vector(Action::Pair { by, on }), of_on(link(by), link(on)))
        }
        Force::Vector(Action::Pair { by, on }) => (force, of_on(link(by), link(on))),
        Force::Vector(Action::OfPin(by, on)) => (force, of_on(pin(by), link(on))),
        Force::Vector(Action::OnPin(by, on)) => (force, of_on(link(by), pin(on))),
        Force::Torque(input) => (force, torque(notation.mechanism().driven_link(input)?)),
        Force::LoadTorque(index) => (force, torque(notation.mechanism().forces.loads.get(index)?.link)),
        _ => return None,
    })
}

/// The same of all that is asked, each once, with its symbol.
pub(super) fn all_whose(notation: &Notation<'_>) -> Vec<Rich> {
    let mut told: Vec<Force> = Vec::new();
    let asked = notation.mechanism().asked.iter();
    let of_force = asked.filter_map(|asked| whose(notation, asked.quantity));
    of_force
        .filter(|(force, _)| {
            let new = !told.contains(force);
            told.push(*force);
            new
        })
        .map(|(force, whose)| {
            let symbol = notation.symbol(Quantity::Force(force, Share::Total), false);
            symbol.up(": ").then(&whose)
        })
        .collect()
}

/// Whether the sign of a number is a sense of turning.
pub(super) fn turns(quantity: Quantity) -> bool {
    quantity.nature() == Nature::Rotation || matches!(quantity, Quantity::Angle(_))
}

/// The same with its places for symbol and axis open.
pub(super) fn prompt_words(words: &'static Words, asked: &Asked, part: Part) -> &'static str {
    let turns = turns(asked.quantity);
    match part {
        Part::Value if turns => words.answer_rotation,
        Part::Value => "{symbol}",
        Part::Magnitude => words.answer_magnitude,
        Part::Direction => words.answer_direction,
        Part::X | Part::Y => words.answer_coordinate,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn symbols_are_those_of_the_sheet() {
        let text = r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 1 } },
            "input": { "link": 2, "angle": 0, "omega": 1 }, "find": ["v(A)", "omega(2)", "x(A)"] }"#;
        let scene = crate::scene::read(text, "crank.json").unwrap();
        let told = |index: usize, part| {
            prompt(&scene, &scene.mechanism.asked[index], part, Language::English)
                .replace("<bdi dir=\"ltr\">", "")
                .replace("</bdi>", "")
        };
        assert_eq!(told(0, Part::Magnitude), "magnitude of <i>V</i><sub>A</sub>");
        assert_eq!(
            told(0, Part::Direction),
            "direction of <i>V</i><sub>A</sub>, counter-clockwise from the x-axis"
        );
        assert!(
            told(1, Part::Value).ends_with("</sub>, counter-clockwise positive"),
            "{}",
            told(1, Part::Value)
        );
        assert!(told(2, Part::Y).ends_with(", coordinate y"));
    }
}
