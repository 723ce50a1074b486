//! The table of inertia: of every link with a mass what it weighs in kilograms, how its mass centre moves, and what its
//! inertia comes to.

use super::notation::Notation;
use super::printed::{Figures, Key};
use super::rich::Rich;
use super::table::{Align, Flow, Table};
use super::{force_names, human};
use crate::graphical::construction::{Construction, MassForces};
use crate::mechanism::LinkId;
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Dimension, Method, Order, Quantity, Unit};

/// M, A_G, F_in, ε, T_in and h of every link with a mass, as the steps print them; none where nothing has a mass.
#[must_use]
pub fn table(
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &Figures,
    size: f64,
) -> Option<Table> {
    let sheet = construction.forces.as_ref()?;
    if sheet.masses.is_empty() {
        return None;
    }
    let acting = sheet.bodies.iter().flat_map(|body| &body.acting).chain(&sheet.inertia);
    let forces: Vec<(LinkId, [f64; 2])> = acting
        .filter_map(|acting| match acting.action {
            Action::Inertia(link) => Some((link, acting.force)),
            _ => None,
        })
        .collect();
    let row = |own: &MassForces| {
        let force = forces.iter().find(|(link, _)| *link == own.link).map(|(_, force)| *force);
        row(own, force, notation, figures)
    };
    let letter = |letter: &str| Rich::italic(letter);
    let direction = || Rich::upright("∠");
    Some(Table {
        columns: vec![
            Align::Middle,
            Align::Right,
            Align::Right,
            Align::Left,
            Align::Right,
            Align::Left,
            Align::Right,
            Align::Right,
            Align::Right,
        ],
        head: vec![
            Rich::upright(notation.words.link_column),
            letter("M"),
            letter(notation.profile.acceleration).sub("G"),
            direction(),
            force_names::of_inertia("F"),
            direction(),
            letter(notation.alpha()),
            force_names::of_inertia("T"),
            letter("h"),
        ],
        rows: sheet.masses.iter().map(row).collect(),
        size,
        gap: 3.6,
        flow: if notation.words.right_to_left { Flow::Leftward } else { Flow::Rightward },
    })
}

/// The row of a link; what it does not have is a dash.
fn row(own: &MassForces, force: Option<[f64; 2]>, notation: &Notation<'_>, figures: &Figures) -> Vec<Rich> {
    let units = &notation.scene.units;
    let none = || Rich::upright("—");
    let amount = |key: Key, si: f64, unit: &Unit| match figures.told(key, si, Method::Polygon) {
        Some(told) => human::with_unit(&human::number_told(told / unit.si, si / unit.si), &unit.symbol),
        None => human::quantity(si, unit),
    };
    let size =
        |force: Force, si: f64, unit: &Unit| amount(Key::Of(Quantity::Force(force, Share::Total)), si, unit);
    // A force against the acceleration, which has no direction where there is none.
    let directions = force.map(|[x, y]| [libm::atan2(-y, -x), libm::atan2(y, x)].map(human::degrees));
    let [of_acceleration, of_force] = directions.unwrap_or_default();
    let inertia_force = force.map_or(0.0, |[x, y]| libm::hypot(x, y));
    let torque = match (own.inertia, own.alpha) {
        (Some(inertia), Some(alpha)) => Some(-inertia * alpha),
        _ => None,
    };
    let turning = |si: f64, number: Rich| notation.with_sense(number, si);
    let offset = torque.filter(|torque| *torque != 0.0).map(|torque| match inertia_force > 0.0 {
        true => size(Force::Offset(own.link), torque.abs() / inertia_force, &units.length),
        false => Rich::upright("∞"),
    });
    let has_mass = own.mass.is_some();
    vec![
        Rich::upright(notation.number(own.link)),
        own.mass.map_or_else(none, |mass| amount(Key::OfLink("M", own.link), mass, &units.mass)),
        if has_mass {
            let quantity = Quantity::Acceleration(own.centre);
            amount(Key::Of(quantity), own.acceleration, &notation.unit(Dimension::Acceleration))
        } else {
            none()
        },
        of_acceleration,
        if has_mass {
            size(Force::Vector(Action::Inertia(own.link)), inertia_force, &units.force)
        } else {
            none()
        },
        of_force,
        own.alpha.map_or_else(none, |alpha| {
            let unit = notation.angular_unit(Order::Acceleration);
            turning(alpha, amount(Key::Of(Quantity::Alpha(own.link)), alpha.abs(), &unit))
        }),
        torque.map_or_else(none, |torque| {
            turning(torque, size(Force::InertiaTorque(own.link), torque.abs(), &units.torque))
        }),
        offset.unwrap_or_else(none),
    ]
}
