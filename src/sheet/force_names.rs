//! The symbols of forces: F₂₃, T₂, F₃ⁱⁿ, h₃, F_S.

use super::font::Face;
use super::notation::Notation;
use super::rich::Rich;
use crate::mechanism::force::{Action, Force, Share, SpringKind};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{Input, Rider};

/// The mark of inertia.
const INERTIA: &str = "in";

/// The name of a force on the half of a governor that is drawn: of what all halves share it has its part.
pub(super) fn acting(notation: &Notation<'_>, action: Action) -> Rich {
    acting_in(notation, action, Share::Total)
}

/// The same with the mark of what it is a part of; what is given has none.
pub(super) fn acting_in(notation: &Notation<'_>, action: Action, share: Share) -> Rich {
    let given =
        matches!(action, Action::Load(_) | Action::Weight(_) | Action::Spring { .. } | Action::Drag(_));
    let share = if given { Share::Total } else { share };
    let name = notation.symbol(Quantity::Force(Force::Vector(action), share), false);
    let halves = notation.mechanism().halves_of(action);
    if halves == 1.0 { name } else { name.up("/").then(&super::human::stated(halves)) }
}

/// The same as a vector in a balance.
pub(super) fn laid_off(notation: &Notation<'_>, action: Action) -> Rich {
    let name = notation.symbol(Quantity::Force(Force::Vector(action), Share::Total), true);
    let halves = notation.mechanism().halves_of(action);
    if halves == 1.0 { name } else { name.up("/").then(&super::human::stated(halves)) }
}

/// The symbol of a load: its name; of one that the scene leaves without a name P, or T of a torque, with the number of the
/// link, and its own number there where the link has several. T₂ of a driven link is its effort: a load on it is T_L2.
pub(super) fn load(notation: &Notation<'_>, index: usize) -> Rich {
    let loads = &notation.mechanism().forces.loads;
    let own = &loads[index];
    if !is_unnamed(notation, index) {
        return Rich::italic(&own.name);
    }
    let alike = |other: &usize| {
        let load = &loads[*other];
        load.link == own.link && load.is_torque() == own.is_torque() && is_unnamed(notation, *other)
    };
    let before = (0..index).filter(alike).count();
    let several = (0..loads.len()).filter(alike).count() > 1;
    let link = notation.number(own.link);
    let sub = if several { format!("{link},{}", before + 1) } else { link };
    let mechanism = notation.mechanism();
    let driven = (0..mechanism.inputs.len()).any(|input| mechanism.driven_link(input) == Some(own.link));
    match (own.is_torque(), driven) {
        (false, _) => Rich::italic("P").sub(&sub),
        (true, false) => Rich::italic("T").sub(&sub),
        (true, true) => Rich::italic("T").sub(&format!("L{sub}")),
    }
}

/// Whether the scene gives a load no name.
pub(super) fn is_unnamed(notation: &Notation<'_>, index: usize) -> bool {
    notation.mechanism().forces.loads[index].name == format!("load {}", index + 1)
}

/// What is of inertia, of whatever link: Fⁱⁿ, Tⁱⁿ.
pub(super) fn of_inertia(letter: &str) -> Rich {
    Rich::italic(letter).scripts(INERTIA, Face::Upright, "")
}

/// The symbol of a part of a force.
pub(super) fn part(notation: &Notation<'_>, action: Action, mark: &str) -> Rich {
    let of = match action {
        Action::Pair { by, on } => {
            let (a, b) = (notation.number(by), notation.number(on));
            let comma = if a.chars().count() > 1 || b.chars().count() > 1 { "," } else { "" };
            format!("{a}{comma}{b}")
        }
        Action::OfPin(pin, link) => format!("{},{}", notation.index(pin), notation.number(link)),
        Action::OnPin(link, pin) => format!("{},{}", notation.number(link), notation.index(pin)),
        other => return symbol(notation, Force::Vector(other), Share::Total),
    };
    Rich::italic("F").scripts(mark, Face::Upright, &of)
}

/// The symbol of a force, with the mark of the part that is meant.
pub(super) fn symbol(notation: &Notation<'_>, force: Force, share: Share) -> Rich {
    let mechanism = notation.mechanism();
    let part = match share {
        Share::Total => "",
        Share::Static => "s",
        Share::Inertia => "d",
        // A dash and two, as governors have them.
        Share::Rising => "′",
        Share::Falling => "″",
    };
    let two = |a: String, b: String| {
        let comma = if a.chars().count() > 1 || b.chars().count() > 1 { "," } else { "" };
        format!("{a}{comma}{b}")
    };
    let marked = |letter: &str, sup: &str, sub: &str| {
        let sup = format!("{sup}{part}");
        Rich::italic(letter).scripts(&sup, Face::Upright, sub)
    };
    let drive = |input: usize| {
        let of = match mechanism.inputs.get(input) {
            Some(Input::Slide { slide, .. }) => match mechanism.slides[*slide].rider {
                Rider::Pin { point, .. } => notation.index(point),
                Rider::Link { link, .. } => notation.number(link),
            },
            _ => String::new(),
        };
        marked("F", "", &of)
    };
    // F_S is the shaking force: the pull of a spring S is P_S.
    let pull = |index: usize| if mechanism.forces.springs[index].name == "S" { "P" } else { "F" };
    let action = |action: Action| match action {
        Action::Pair { by, on } => marked("F", "", &two(notation.number(by), notation.number(on))),
        Action::OfPin(pin, link) => {
            marked("F", "", &format!("{},{}", notation.index(pin), notation.number(link)))
        }
        Action::OnPin(link, pin) => {
            marked("F", "", &format!("{},{}", notation.number(link), notation.index(pin)))
        }
        Action::Inertia(link) => marked("F", INERTIA, &notation.number(link)),
        Action::Centrifugal(link) => marked("F", "", &format!("c{}", notation.number(link))),
        Action::Shaking => marked("F", "", "S"),
        Action::OnFrame => marked("F", "", "1"),
        Action::Load(index) => load(notation, index),
        Action::Weight(link) => marked("W", "", &notation.number(link)),
        Action::Spring { index, .. } => marked(pull(index), "", &mechanism.forces.springs[index].name),
        Action::Drive(input) => drive(input),
        Action::DriveBack(input) => Rich::upright("−").then(&drive(input)),
        Action::Drag(_) => marked("F", "", "f"),
        Action::Rolling { roll, on } => {
            let [by, on] = mechanism.bodies_rolling(roll, on);
            marked("F", "", &two(notation.number(by), notation.number(on)))
        }
    };
    match force {
        Force::Vector(of) => action(of),
        Force::Along { by, on, .. } => {
            marked("F", notation.profile.normal, &two(notation.number(by), notation.number(on)))
        }
        Force::Across { by, on, .. } => {
            marked("F", notation.profile.tangential, &two(notation.number(by), notation.number(on)))
        }
        Force::Torque(input) => {
            let link = mechanism.driven_link(input).map(|link| notation.number(link)).unwrap_or_default();
            marked("T", "", &link)
        }
        Force::Drive(input) => drive(input),
        Force::LoadTorque(index) => load(notation, index),
        Force::Pull(index) | Force::Twist(index) => {
            let spring = &mechanism.forces.springs[index];
            let letter = if matches!(spring.kind, SpringKind::Pull(_)) { pull(index) } else { "T" };
            marked(letter, "", &spring.name)
        }
        Force::Spin => marked("ω", "", ""),
        Force::InertiaTorque(link) => marked("T", INERTIA, &notation.number(link)),
        Force::Offset(link) => marked("h", "", &notation.number(link)),
        Force::Moment(of, about) => {
            Rich::italic("M").sub(&notation.index(about)).up("(").then(&action(of)).up(")")
        }
        Force::Arm(of, about) => {
            Rich::italic("a").sub(&notation.index(about)).up("(").then(&action(of)).up(")")
        }
    }
}
