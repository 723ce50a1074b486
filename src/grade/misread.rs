//! One given number of the skeleton misread, and carried through: what everybody has misread once. Whether it was, all
//! answers together tell.

use std::f64::consts::{FRAC_PI_2, PI};

use super::case::Case;
use super::change::{Change, InputChange};
use super::kind::Kind;
use super::mistakes::Hypothesis;
use crate::given::Given;
use crate::mechanism::{Form, Input, LinkId, Mechanism, Place, PointId};

/// What it costs that a number was misread of which nothing is handed in.
const MISREAD: f64 = 2.0;

/// Every usual misreading of one given number, or of two that stand beside each other.
pub(super) fn all(case: &Case<'_>) -> Vec<Hypothesis> {
    let mechanism = &case.mechanism;
    let unit = case.scene.units.length.si;
    let symbol = &case.scene.units.length.symbol;
    let mut found = Vec::new();
    let mut add = |kind: Kind, at: &str, how: String, changes: Vec<InputChange>| {
        let change = Change { inputs: changes, ..Change::default() };
        if change.mechanism(mechanism).as_ref() != mechanism {
            let how = Some(how);
            found.push(Hypothesis { kind, at: at.to_owned(), step: None, price: MISREAD, change, how });
        }
    };
    let told = |metres: f64| written(metres / unit);
    for (index, point) in mechanism.points.iter().enumerate() {
        let Place::Fixed(at) = point.place else { continue };
        let [x, y] = at.map(|given| given.value);
        let mut ways = vec![[y, x], [-x, y], [x, -y]];
        ways.extend(transposed(x / unit).into_iter().map(|own| [own * unit, y]));
        ways.extend(transposed(y / unit).into_iter().map(|own| [x, own * unit]));
        for own in ways.into_iter().filter(|own| *own != [x, y]) {
            let how = format!("({}, {}) for ({}, {}) {symbol}", told(own[0]), told(own[1]), told(x), told(y));
            let by = [own[0] - x, own[1] - y];
            let pivot = InputChange::Pivot { point: PointId(index), by };
            add(Kind::PivotMisplaced, &point.name, how, vec![pivot]);
        }
    }
    let lengths = lengths(mechanism);
    let name = |link: LinkId, ends: [usize; 2]| {
        let points = ends.map(|end| mechanism.link(link).points[end]);
        points.map(|point| mechanism.point(point).name.as_str()).concat()
    };
    for (place, &(link, ends, length)) in lengths.iter().enumerate() {
        let at = format!("the length {}", name(link, ends));
        let other = |own: f64| InputChange::Length { link, ends, factor: own / length };
        // Of a straight link with three points a distance may be taken from another of them.
        let from_others = lengths.iter().filter(|(of, others, _)| {
            matches!(mechanism.link(link).form, Form::Line(_)) && *of == link && *others != ends
        });
        let from_others = from_others.flat_map(|(.., to)| [length - to, length + to]);
        for own in [length / 2.0, 2.0 * length]
            .into_iter()
            .chain(from_others)
            .chain(transposed(length / unit).into_iter().map(|own| own * unit))
        {
            let how = format!("{} for {} {symbol}", told(own), told(length));
            add(Kind::LengthLaidOff, &at, how, vec![other(own)]);
        }
        for &(with, its_ends, its_length) in &lengths[place + 1..] {
            let how = format!("interchanged with {}", name(with, its_ends));
            let its = InputChange::Length { link: with, ends: its_ends, factor: length / its_length };
            add(Kind::LengthLaidOff, &at, how, vec![other(its_length), its]);
        }
    }
    for (input, given) in mechanism.inputs.iter().enumerate() {
        let (Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. }) = given
        else {
            continue;
        };
        let degrees = angle.value.to_degrees();
        let mut ways = vec![(PI, "half a turn away".to_owned())];
        ways.extend([FRAC_PI_2, -FRAC_PI_2].map(|by| (by, "a quarter of a turn away".to_owned())));
        ways.extend(transposed(degrees).into_iter().map(|own| {
            let how = format!("{} for {} deg", written(own), written(degrees));
            ((own - degrees).to_radians(), how)
        }));
        for (by, how) in ways {
            add(Kind::InputAngle, "the input", how, vec![InputChange::Angle { input, by }]);
        }
    }
    found
}

/// The lengths that are given of links, with the joints between which they lie, metres.
fn lengths(mechanism: &Mechanism) -> Vec<(LinkId, [usize; 2], f64)> {
    let mut all = Vec::new();
    for link in mechanism.moving() {
        let of: Vec<([usize; 2], f64)> = match &mechanism.link(link).form {
            Form::Length(length) => vec![([0, 1], length.value)],
            Form::Sides { first_second, second_third, third_first, .. } => {
                vec![([0, 1], first_second.value), ([1, 2], second_third.value), ([0, 2], third_first.value)]
            }
            Form::Arms { second, third, .. } => vec![([0, 1], second.value), ([0, 2], third.value)],
            Form::Line(places) => {
                let from_first = |(end, place): (usize, &Given)| ([0, end], place.value - places[0].value);
                places.iter().enumerate().map(from_first).collect()
            }
            _ => Vec::new(),
        };
        all.extend(of.into_iter().filter(|(_, length)| *length > 0.0).map(|(ends, l)| (link, ends, l)));
    }
    all
}

/// A number as it was written, not as it was converted.
pub(super) fn written(number: f64) -> String {
    format!("{}", libm::round(number * 1e6) / 1e6)
}

/// A number with two of its digits that stand beside each other interchanged, every way.
fn transposed(number: f64) -> Vec<f64> {
    let text = written(number);
    if text.len() > WRITTEN {
        return Vec::new();
    }
    let digits: Vec<char> = text.chars().collect();
    let swapped = |place: usize| {
        let mut own = digits.clone();
        own.swap(place, place + 1);
        let both = digits[place].is_ascii_digit() && digits[place + 1].is_ascii_digit();
        let number = own.iter().collect::<String>().parse::<f64>().ok()?;
        (both && digits[place] != digits[place + 1] && number != 0.0).then_some(number)
    };
    (0..digits.len().saturating_sub(1)).filter_map(swapped).collect()
}

/// No given number is written with more signs.
const WRITTEN: usize = 7;
