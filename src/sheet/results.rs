//! The result table and the line of given data.

use super::human;
use super::notation::Notation;
use super::rich::Rich;
use super::table::{Align, Table};
use crate::graphical::construction::{Construction, Reading};
use crate::mechanism::quantity::{Answer, Asked, Indeterminate, Method, Order, Quantity};
use crate::mechanism::{Direction, Form, GuidePoint, Input, LinkId, Path, Place, PointId, Rider};

/// The asked quantities of these orders with their values, senses and directions.
#[must_use]
pub fn table(construction: &Construction, notation: &Notation<'_>, orders: &[Order], size: f64) -> Table {
    let words = notation.words;
    let rows = notation
        .mechanism()
        .asked
        .iter()
        .zip(&construction.answers)
        .filter(|(asked, _)| orders.contains(&polygon_of(asked.quantity)))
        .map(|(asked, reading)| row(asked, reading, notation))
        .collect();
    Table {
        columns: vec![Align::Left, Align::Right, Align::Left],
        head: [words.quantity, words.value, words.sense].into_iter().map(Rich::italic).collect(),
        rows,
        size,
        gap: 4.0,
    }
}

/// The polygon on which a quantity is read: normal parts need velocities only, and stand in the
/// acceleration polygon all the same.
fn polygon_of(quantity: Quantity) -> Order {
    match quantity {
        Quantity::RelativeNormal(..)
        | Quantity::Normal(_)
        | Quantity::SlipNormal(..)
        | Quantity::Coriolis(..) => Order::Acceleration,
        other => other.order(),
    }
}

fn row(asked: &Asked, reading: &Reading, notation: &Notation<'_>) -> Vec<Rich> {
    let words = notation.words;
    let mut symbol = notation.symbol(asked.quantity, false);
    if let Some(method) = method(asked.method, notation) {
        symbol = symbol.up(",\u{a0}").up(method);
    }
    match &reading.answer {
        Answer::Scalar { value, .. } => match asked.quantity {
            Quantity::Omega(_)
            | Quantity::RelativeOmega(..)
            | Quantity::Alpha(_)
            | Quantity::RelativeAlpha(..) => {
                let value_cell = human::quantity(value.abs(), &asked.unit);
                vec![symbol, value_cell, Rich::upright(notation.sense(*value))]
            }
            _ => vec![symbol, human::quantity(*value, &asked.unit), Rich::default()],
        },
        Answer::Vector { value: [x, y], bound } => {
            if let Quantity::Position(_) | Quantity::Centre(..) = asked.quantity {
                // A coordinate that is zero within its bound reads as zero.
                let part = |v: &f64| human::number(if v.abs() <= *bound { 0.0 } else { v / asked.unit.si });
                let pair = Rich::upright("(").then(&part(x)).up(";\u{a0}").then(&part(y)).up(")");
                return vec![symbol, human::with_unit(&pair, &asked.unit.symbol), Rich::default()];
            }
            let size = libm::hypot(*x, *y);
            let direction = if size > 0.0 {
                Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(*y, *x)))
            } else {
                Rich::default()
            };
            vec![symbol, human::quantity(size, &asked.unit), direction]
        }
        Answer::AtInfinity { direction: [x, y], .. } => {
            let angle = libm::remainder(libm::atan2(*y, *x), std::f64::consts::PI);
            let angle = if angle < 0.0 { angle + std::f64::consts::PI } else { angle };
            let text = Rich::upright("∠\u{a0}").then(&human::degrees(angle));
            vec![symbol, Rich::upright("∞").up("\u{a0}").up(words.at_infinity), text]
        }
        Answer::Indeterminate(why) => vec![symbol, Rich::upright("—"), Rich::italic(reason(why, notation))],
    }
}

/// The method by which a quantity was asked, where it is not the usual one.
fn method(method: Method, notation: &Notation<'_>) -> Option<&'static str> {
    let words = notation.words;
    match method {
        Method::Polygon => None,
        Method::Centres => Some(words.method_centres),
        Method::LineOfCentres => Some(words.method_line_of_centres),
        Method::LinkToLink => Some(words.method_link_to_link),
        Method::GaugeLine => Some(words.method_gauge_line),
        Method::Klein => Some(words.method_klein),
    }
}

fn reason(why: &Indeterminate, notation: &Notation<'_>) -> String {
    match why {
        Indeterminate::DeadCentre { links } if !links.is_empty() => {
            let numbers: Vec<String> = links.iter().map(u32::to_string).collect();
            format!("{} ({})", notation.words.dead_centre, numbers.join(", "))
        }
        Indeterminate::DeadCentre { .. } => notation.words.dead_centre.to_owned(),
        Indeterminate::Singular => notation.words.not_determined.to_owned(),
        Indeterminate::Undefined { .. } => notation.words.undefined.to_owned(),
    }
}

/// The dimensions and the motion that the scene states, as one paragraph.
#[must_use]
pub fn given(notation: &Notation<'_>) -> Rich {
    let mechanism = notation.mechanism();
    let length = &notation.scene.units.length;
    let equals = |symbol: Rich, value: Rich| symbol.up("\u{a0}=\u{a0}").then(&value);
    let mut parts: Vec<Rich> = Vec::new();
    for link in mechanism.moving().map(|l| mechanism.link(l)) {
        let mut distance = |a: usize, b: usize, si: f64| {
            if let (Some(a), Some(b)) = (link.points.get(a), link.points.get(b)) {
                // The pivot first, as one reads the mechanism.
                let (a, b) = if mechanism.is_fixed(*b) && !mechanism.is_fixed(*a) { (b, a) } else { (a, b) };
                parts.push(equals(notation.length(*a, *b), human::stated_quantity(si, length)));
            }
        };
        match &link.form {
            Form::Length(l) => distance(0, 1, l.value),
            Form::Line(positions) => {
                // Each piece between neighbours along the line is a dimension.
                let mut along: Vec<usize> = (0..positions.len()).collect();
                along.sort_by(|a, b| positions[*a].value.total_cmp(&positions[*b].value));
                for pair in along.windows(2) {
                    distance(pair[0], pair[1], positions[pair[1]].value - positions[pair[0]].value);
                }
            }
            Form::Sides { first_second, second_third, third_first, .. } => {
                distance(0, 1, first_second.value);
                distance(1, 2, second_third.value);
                distance(2, 0, third_first.value);
            }
            Form::Arms { second, third, .. } => {
                distance(0, 1, second.value);
                distance(0, 2, third.value);
            }
            Form::Shape(_) | Form::Placed | Form::Single => {}
        }
    }
    let place = |x: f64, y: f64| {
        let number = |si: f64| human::stated(si / length.si);
        let pair = Rich::upright("(").then(&number(x)).up(";\u{a0}").then(&number(y)).up(")");
        human::with_unit(&pair, &length.symbol)
    };
    for (i, point) in mechanism.points.iter().enumerate() {
        // The origin, where the sheet begins, needs no saying.
        if let Place::Fixed([x, y]) | Place::Placed([x, y]) = point.place
            && (x.value != 0.0 || y.value != 0.0)
        {
            parts.push(notation.point(PointId(i)).up("\u{a0}").then(&place(x.value, y.value)));
        }
    }
    for (i, slide) in mechanism.slides.iter().enumerate() {
        if slide.guide.link == LinkId::FRAME
            && let Path::Straight {
                through: GuidePoint::Own([x, y]),
                direction: Direction::Angle(angle),
                turned,
                ..
            } = slide.guide.path
        {
            parts.push(Rich::fill(
                notation.words.given_guide,
                &[
                    ("guide", notation.guide(i)),
                    ("place", place(x.value, y.value)),
                    ("angle", human::degrees(angle.value + turned.value)),
                ],
            ));
        }
    }
    for input in &mechanism.inputs {
        match input {
            Input::Angle { link, angle, omega, alpha } => {
                if let Some(angle) = angle {
                    parts.push(equals(
                        notation.symbol(Quantity::Angle(*link), false),
                        human::degrees(angle.value),
                    ));
                }
                let rotation = |value: f64, order| {
                    let unit = notation.angular_unit(order);
                    let number = human::stated_quantity(value.abs(), &unit);
                    let sense = notation.sense(value);
                    if sense.is_empty() { number } else { number.up("\u{a0}").up(sense) }
                };
                let velocity = rotation(omega.value, Order::Velocity);
                parts.push(equals(notation.symbol(Quantity::Omega(*link), false), velocity));
                if alpha.value != 0.0 {
                    let acceleration = rotation(alpha.value, Order::Acceleration);
                    parts.push(equals(notation.symbol(Quantity::Alpha(*link), false), acceleration));
                }
            }
            Input::Speed { angle, point, speed, link, .. } => {
                if let Some(angle) = angle {
                    parts.push(equals(
                        notation.symbol(Quantity::Angle(*link), false),
                        human::degrees(angle.value),
                    ));
                }
                let unit = notation.unit(Order::Velocity);
                let value = human::stated_quantity(speed.value.abs(), &unit);
                let value = value.up("\u{a0}").up(notation.sense(speed.value));
                parts.push(equals(notation.symbol(Quantity::Velocity(*point), false), value));
            }
            Input::Slide { slide, velocity, acceleration, .. } => {
                let rider = mechanism.slides.get(*slide).map(|s| s.rider);
                let point = match rider {
                    Some(Rider::Pin { point, .. }) => Some(point),
                    Some(Rider::Link { link, .. }) => {
                        mechanism.links.get(link.0).and_then(|l| l.points.first().copied())
                    }
                    None => None,
                };
                let Some(point) = point else { continue };
                let unit = notation.unit(Order::Velocity);
                parts.push(equals(
                    notation.symbol(Quantity::Velocity(point), false),
                    human::stated_quantity(velocity.value, &unit),
                ));
                if acceleration.value != 0.0 {
                    let unit = notation.unit(Order::Acceleration);
                    parts.push(equals(
                        notation.symbol(Quantity::Acceleration(point), false),
                        human::stated_quantity(acceleration.value, &unit),
                    ));
                }
            }
        }
    }
    if parts.is_empty() {
        return Rich::default();
    }
    Rich::italic(notation.words.given).up(" ").then(&Rich::join(&parts, &Rich::upright(", ")))
}
