//! The result table.

use super::cycle::energy_unit;
use super::notation::Notation;
use super::printed::{Figures, Key};
use super::rich::Rich;
use super::table::{Align, Flow, Table};
use super::{given, human};
use crate::graphical::construction::{Construction, Reading};
use crate::mechanism::force::{Force, Share};
use crate::mechanism::quantity::{Answer, Asked, Dimension, Indeterminate, Method, Order, Quantity};

/// The asked quantities of these orders with their values, senses and directions: the numbers to which the steps have come
/// where these are the result as far as readings tell it, in the figures of a result.
#[must_use]
pub fn table(
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &Figures,
    orders: &[Order],
    size: f64,
) -> Table {
    let words = notation.words;
    let rows = notation
        .mechanism()
        .asked
        .iter()
        .zip(&construction.answers)
        .filter(|(asked, _)| is_row(asked, notation, orders))
        .map(|(asked, reading)| row((asked, reading), construction, notation, figures))
        .collect();
    Table {
        columns: vec![Align::Left, Align::Right, Align::Left],
        head: [words.quantity, words.value, words.sense].into_iter().map(Rich::italic).collect(),
        rows,
        size,
        gap: 4.0,
        flow: if words.right_to_left { Flow::Leftward } else { Flow::Rightward },
    }
}

/// How many rows the table of these orders has.
pub(super) fn count(notation: &Notation<'_>, orders: &[Order]) -> usize {
    notation.mechanism().asked.iter().filter(|asked| is_row(asked, notation, orders)).count()
}

/// Whether a quantity has a row among those of these orders.
fn is_row(asked: &Asked, notation: &Notation<'_>, orders: &[Order]) -> bool {
    orders.contains(&polygon_of(asked.quantity)) && is_result(asked, notation)
}

/// What the scene states is no result, where anything else is.
pub(super) fn is_result(asked: &Asked, notation: &Notation<'_>) -> bool {
    let open = |asked: &Asked| !given::is_stated(asked.quantity, notation);
    open(asked) || !notation.mechanism().asked.iter().any(open)
}

/// The scales that the scene states, for a question.
#[must_use]
pub fn stated_scales(notation: &Notation<'_>) -> Option<Rich> {
    let sheet = &notation.scene.sheet;
    let list: Vec<Rich> = [
        sheet.length_scale.map(|ratio| notation.length_scale(ratio / 1000.0)),
        sheet.velocity_scale.map(|k| notation.scale(k, Dimension::Velocity)),
        sheet.acceleration_scale.map(|k| notation.scale(k, Dimension::Acceleration)),
        sheet.force_scale.map(|k| {
            let unit = &notation.scene.units.force;
            let value = human::with_unit(&human::stated(k * 10.0 / unit.si), &unit.symbol);
            value.up("\u{a0}≡\u{a0}1\u{a0}cm")
        }),
    ]
    .into_iter()
    .flatten()
    .collect();
    let comma = Rich::upright(notation.words.comma);
    let told = || Rich::fill(notation.words.given_scales, &[("list", Rich::join(&list, &comma))]);
    (!list.is_empty()).then(told)
}

/// The polygon on which a quantity is read: normal parts need velocities only, and stand in the
/// acceleration polygon all the same.
pub(super) fn polygon_of(quantity: Quantity) -> Order {
    match quantity {
        Quantity::RelativeNormal(..)
        | Quantity::Normal(_)
        | Quantity::SlipNormal(..)
        | Quantity::Coriolis(..) => Order::Acceleration,
        other => other.order(),
    }
}

fn row(
    (asked, reading): (&Asked, &Reading),
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &Figures,
) -> Vec<Rich> {
    let words = notation.words;
    let mut symbol = notation.symbol(asked.quantity, false);
    if let Some(method) = notation.method(asked.method) {
        symbol = symbol.up(words.comma.trim_end()).up("\u{a0}").up(method);
    }
    let key = Key::of(asked.quantity, notation);
    // An energy has the name that its unit has in the lines.
    let unit = match asked.quantity {
        Quantity::Cycle(of) if of.is_energy() => energy_unit(&asked.unit.symbol),
        _ => asked.unit.symbol.clone(),
    };
    // By the lever, and beside it, it has the figures of its line.
    let by_lever = |other: &&Asked| other.quantity == asked.quantity && other.method == Method::Lever;
    let finer = usize::from(notation.mechanism().asked.iter().any(|other| by_lever(&other)));
    let amount = |si: f64| {
        let told = figures.told(key, si, asked.method);
        let number = match told {
            _ if finer > 0 => human::limited(told.unwrap_or(si) / asked.unit.si, finer).0,
            Some(told) => human::number_told(told / asked.unit.si, si / asked.unit.si),
            None => human::number(si / asked.unit.si),
        };
        human::with_unit(&number, &unit)
    };
    match &reading.answer {
        // What is not told from zero reads as zero, here and below.
        Answer::Scalar { value, .. } if reading.zero && *value != 0.0 => {
            let none = Answer::Scalar { value: 0.0, bound: 0.0 };
            row((asked, &Reading { answer: none, ..reading.clone() }), construction, notation, figures)
        }
        Answer::Scalar { value, .. } => match asked.quantity {
            Quantity::Omega(_)
            | Quantity::RelativeOmega(..)
            | Quantity::Alpha(_)
            | Quantity::RelativeAlpha(..) => {
                let value_cell = amount(value.abs());
                vec![symbol, value_cell, Rich::upright(notation.sense(*value))]
            }
            Quantity::Force(force, _) if force.turns() => {
                let value_cell = amount(value.abs());
                vec![symbol, value_cell, Rich::upright(notation.sense(*value))]
            }
            Quantity::Force(Force::Spin, share) if asked.unit.symbol.starts_with("rad/") => {
                let rpm = super::governor::rpm();
                let turns = human::quantity(*value, &rpm);
                // With as many figures as the other unit takes to be what is printed.
                let [own] = human::closing([*value / asked.unit.si], *value / rpm.si, |[own]| {
                    own * asked.unit.si / rpm.si
                });
                let own = human::with_unit(&own, &asked.unit.symbol);
                let sense = match share {
                    Share::Rising => words.governor_up,
                    Share::Falling => words.governor_down,
                    Share::Total | Share::Static | Share::Inertia => "",
                };
                vec![symbol, own.up("\u{a0}= ").then(&turns), Rich::upright(sense)]
            }
            Quantity::Cycle(_) if *value > 0.0 => vec![symbol, amount(*value), Rich::default()],
            _ => vec![symbol, amount(*value), Rich::default()],
        },
        Answer::Vector { value: [x, y], bound } => {
            if let Quantity::Position(_) | Quantity::Centre(..) = asked.quantity {
                let told = construction.told_place([*x, *y], *bound);
                return vec![symbol, super::derived::place(told, asked), Rich::default()];
            }
            let size = libm::hypot(*x, *y);
            let size = if reading.zero { 0.0 } else { size };
            let direction = if size > 0.0 {
                Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(*y, *x)))
            } else {
                Rich::default()
            };
            vec![symbol, amount(size), direction]
        }
        Answer::AtInfinity { .. } if matches!(asked.quantity, Quantity::Force(..)) => {
            vec![symbol, Rich::upright("∞").word(words.at_infinity), Rich::default()]
        }
        Answer::AtInfinity { direction: [x, y], .. } => {
            let angle = libm::remainder(libm::atan2(*y, *x), std::f64::consts::PI);
            let angle = if angle < 0.0 { angle + std::f64::consts::PI } else { angle };
            let text = Rich::upright("∠\u{a0}").then(&human::degrees(angle));
            vec![symbol, Rich::upright("∞").word(words.at_infinity), text]
        }
        Answer::Indeterminate(why) => vec![symbol, Rich::upright("—"), Rich::italic(reason(why, notation))],
    }
}

fn reason(why: &Indeterminate, notation: &Notation<'_>) -> String {
    match why {
        Indeterminate::DeadCentre { links } if !links.is_empty() => {
            let numbers: Vec<String> = links.iter().map(u32::to_string).collect();
            format!("{} ({})", notation.words.dead_centre, numbers.join(notation.words.comma))
        }
        Indeterminate::DeadCentre { .. } => notation.words.dead_centre.to_owned(),
        Indeterminate::Singular | Indeterminate::Unclear | Indeterminate::Room { .. } => {
            notation.words.not_determined.to_owned()
        }
        Indeterminate::NoEquilibrium { .. } => notation.words.no_equilibrium.to_owned(),
        Indeterminate::Rubbing { .. } | Indeterminate::Undefined { .. } => {
            notation.words.undefined.to_owned()
        }
    }
}
