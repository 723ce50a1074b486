//! One given number of the skeleton misread, and carried through: what everybody has misread once. Whether it was, all
//! answers together tell.

use std::f64::consts::{FRAC_PI_2, PI};

use super::case::Case;
use super::change::{Change, InputChange};
use super::kind::Kind;
use super::mistakes::Hypothesis;
use super::phrase::{Phrase, say};
use crate::given::Given;
use crate::mechanism::{Direction, Form, GuidePoint, Input, LinkId, Mechanism, Path, Place, PointId, Rider};

/// What it costs that a number was misread of which nothing is handed in.
const MISREAD: f64 = 2.0;

/// Every usual misreading of one given number, or of two that stand beside each other.
pub(super) fn all(case: &Case<'_>) -> Vec<Hypothesis> {
    let mechanism = &case.mechanism;
    let unit = case.scene.units.length.si;
    let symbol = &case.scene.units.length.symbol;
    let mut found = Vec::new();
    let mut add = |kind: Kind, at: Phrase, how: Phrase, changes: Vec<InputChange>| {
        let change = Change { inputs: changes, ..Change::default() };
        if change.mechanism(mechanism).as_ref() != mechanism {
            let how = Some(how);
            found.push(Hypothesis { kind, at, step: None, price: MISREAD, change, how });
        }
    };
    let told = |metres: f64| written(metres / unit);
    for (index, point) in mechanism.points.iter().enumerate() {
        let Place::Fixed(at) = point.place else { continue };
        let [x, y] = at.map(|given| given.value);
        let mut ways = vec![[y, x], [-x, y], [x, -y], [x / 2.0, y], [2.0 * x, y], [x, y / 2.0], [x, 2.0 * y]];
        ways.extend(transposed(x / unit).into_iter().map(|own| [own * unit, y]));
        ways.extend(transposed(y / unit).into_iter().map(|own| [x, own * unit]));
        for own in ways.into_iter().filter(|own| *own != [x, y]) {
            let how = say!("({}, {}) for ({}, {}) {}", told(own[0]), told(own[1]), told(x), told(y), symbol);
            let by = [own[0] - x, own[1] - y];
            let pivot = InputChange::Pivot { point: PointId(index), by };
            add(Kind::PivotMisplaced, Phrase::from(&point.name), how, vec![pivot]);
        }
    }
    let lengths = lengths(mechanism);
    let name = |link: LinkId, ends: [usize; 2]| {
        let points = ends.map(|end| mechanism.link(link).points[end]);
        points.map(|point| mechanism.point(point).name.as_str()).concat()
    };
    for (place, &(link, ends, length)) in lengths.iter().enumerate() {
        let at = say!("the length {}", name(link, ends));
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
            let how = say!("{} for {} {}", told(own), told(length), symbol);
            add(Kind::LengthLaidOff, at.clone(), how, vec![other(own)]);
        }
        for &(with, its_ends, its_length) in &lengths[place + 1..] {
            let how = say!("interchanged with {}", name(with, its_ends));
            let its = InputChange::Length { link: with, ends: its_ends, factor: length / its_length };
            add(Kind::LengthLaidOff, at.clone(), how, vec![other(its_length), its]);
        }
    }
    for (slide, how, change) in guides(case) {
        add(Kind::GuideMisplaced, rider(mechanism, slide), how, vec![change]);
    }
    for (input, given) in mechanism.inputs.iter().enumerate() {
        let (Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. }) = given
        else {
            continue;
        };
        let degrees = angle.value.to_degrees();
        let mut ways = vec![(PI, say!("half a turn away"))];
        ways.extend([FRAC_PI_2, -FRAC_PI_2].map(|by| (by, say!("a quarter of a turn away"))));
        ways.extend(transposed(degrees).into_iter().map(|own| {
            let how = say!("{} for {} deg", written(own), written(degrees));
            ((own - degrees).to_radians(), how)
        }));
        for (by, how) in ways {
            add(Kind::InputAngle, say!("the input"), how, vec![InputChange::Angle { input, by }]);
        }
    }
    // A speed in the unit in which it is usually written: only one in which it is a short number has digits to be interchanged.
    let units = [("rad/s", 1.0), ("rpm", PI / 30.0), ("rev/s", 2.0 * PI)];
    let speed = mechanism.inputs.iter().find_map(|input| match input {
        Input::Angle { omega, .. } => Some(omega.value.abs()).filter(|speed| *speed > 0.0),
        Input::Speed { .. } | Input::Slide { .. } => None,
    });
    for (speed, (symbol, unit)) in speed.into_iter().flat_map(|speed| units.map(|unit| (speed, unit))) {
        for own in transposed(speed / unit) {
            let how = say!("{} for {} {}", written(own), written(speed / unit), symbol);
            let factor = own * unit / speed;
            add(
                Kind::InputSpeed,
                say!("the input"),
                how,
                vec![InputChange::Rates { omega: factor, alpha: 1.0 }],
            );
        }
    }
    found
}

/// A straight guide of the frame: its slide, a point of it and its direction, metres in the world.
pub(super) struct Guideway {
    pub(super) slide: usize,
    pub(super) through: [f64; 2],
    pub(super) along: [f64; 2],
}

impl Guideway {
    /// All whose direction is given as an angle.
    pub(super) fn all(mechanism: &Mechanism) -> Vec<Self> {
        let guide = |(slide, pair): (usize, &crate::mechanism::Slide)| {
            let Path::Straight { through, direction: Direction::Angle(angle), turned, offset } =
                pair.guide.path
            else {
                return None;
            };
            let at = match through {
                GuidePoint::Own(at) => at,
                GuidePoint::Point(point) => match mechanism.point(point).place {
                    Place::Fixed(at) => at,
                    _ => return None,
                },
            };
            let angle = angle.value + turned.value;
            let along = [libm::cos(angle), libm::sin(angle)];
            let by = offset.value;
            let through = [at[0].value - by * along[1], at[1].value + by * along[0]];
            (pair.guide.link == LinkId::FRAME).then_some(Self { slide, through, along })
        };
        mechanism.slides.iter().enumerate().filter_map(guide).collect()
    }

    /// How far it passes to the left of a point.
    pub(super) fn beside(&self, [x, y]: [f64; 2]) -> f64 {
        self.along[0] * (self.through[1] - y) - self.along[1] * (self.through[0] - x)
    }
}

/// What slides on a guide, as people call it.
pub(super) fn rider(mechanism: &Mechanism, slide: usize) -> Phrase {
    match mechanism.slides[slide].rider {
        Rider::Pin { point, .. } => Phrase::from(&mechanism.point(point).name),
        Rider::Link { link, .. } => say!("link {}", mechanism.link(link).number),
    }
}

/// The guides of the frame with their offset from a pivot forgotten, or laid off to its other side: with the slide and what
/// was done.
pub(super) fn offsets(case: &Case<'_>) -> Vec<(usize, Phrase, InputChange)> {
    let mechanism = &case.mechanism;
    let mut found = Vec::new();
    for guide in Guideway::all(mechanism) {
        for (pivot, far) in distances(mechanism, &guide) {
            let shifted = |across: f64| InputChange::Guide { slide: guide.slide, across, turn: 0.0 };
            found.push((guide.slide, say!("through {}", pivot), shifted(-far)));
            found.push((guide.slide, say!("on the other side of {}", pivot), shifted(-2.0 * far)));
        }
    }
    found
}

/// How far a guide passes to the left of every pivot through which it does not go.
fn distances(mechanism: &Mechanism, guide: &Guideway) -> Vec<(String, f64)> {
    let fixed = mechanism.points.iter().filter_map(|point| match point.place {
        Place::Fixed(at) => Some((point.name.clone(), guide.beside(at.map(|given| given.value)))),
        _ => None,
    });
    let size = libm::hypot(guide.through[0], guide.through[1]);
    fixed.filter(|(_, far)| far.abs() > 1e-9 * size).collect()
}

/// Every other usual misreading of where a guide of the frame lies.
fn guides(case: &Case<'_>) -> Vec<(usize, Phrase, InputChange)> {
    let mechanism = &case.mechanism;
    let (unit, symbol) = (case.scene.units.length.si, &case.scene.units.length.symbol);
    let mut found = Vec::new();
    for guide in Guideway::all(mechanism) {
        let slide = guide.slide;
        for (pivot, far) in distances(mechanism, &guide) {
            let digits = transposed(far / unit).into_iter().map(|own| own * unit);
            for own in [far / 2.0, 2.0 * far].into_iter().chain(digits) {
                let [own_told, told] = [own, far].map(|metres| written(metres.abs() / unit));
                let how = say!("{} for {} {} from {}", own_told, told, symbol, pivot);
                found.push((slide, how, InputChange::Guide { slide, across: own - far, turn: 0.0 }));
            }
        }
        let [x, y] = guide.through;
        for (own, how) in [
            ([y, x], say!("x and y interchanged")),
            ([-x, y], say!("x with the other sign")),
            ([x, -y], say!("y with the other sign")),
        ] {
            let across = -guide.beside(own);
            found.push((slide, how, InputChange::Guide { slide, across, turn: 0.0 }));
        }
        let degrees = libm::atan2(guide.along[1], guide.along[0]).to_degrees();
        let others = [-degrees, 90.0 - degrees].into_iter().chain(transposed(degrees));
        for own in others.filter(|own| libm::sin((own - degrees).to_radians()).abs() > 1e-9) {
            let how = say!("{} for {} deg", written(own), written(degrees));
            let turn = (own - degrees).to_radians();
            found.push((slide, how, InputChange::Guide { slide, across: 0.0, turn }));
        }
    }
    found
}

/// Usual misreadings of where the third point of a link stands, with what was done.
pub(super) fn third_points(case: &Case<'_>) -> Vec<(PointId, Phrase, InputChange)> {
    let mechanism = &case.mechanism;
    let (unit, symbol) = (case.scene.units.length.si, &case.scene.units.length.symbol);
    let mut found = Vec::new();
    for link in mechanism.moving() {
        let points = &mechanism.link(link).points;
        let (Form::Arms { second, third, angle }, &[first, other, point]) =
            (&mechanism.link(link).form, &points[..])
        else {
            continue;
        };
        let name = |id: PointId| mechanism.point(id).name.as_str();
        let degrees = angle.value.to_degrees();
        let others = [90.0 - degrees, 180.0 - degrees, -degrees].into_iter().chain(transposed(degrees));
        for own in others.filter(|own| libm::sin((own - degrees).to_radians() / 2.0).abs() > 1e-9) {
            let corner = [other, first, point].map(name).concat();
            let how = say!("∠{} {} for {} deg", corner, written(own), written(degrees));
            let turn = (own - degrees).to_radians();
            found.push((point, how, InputChange::Arm { link, end: 2, factor: 1.0, turn }));
        }
        let arm = third.value;
        let digits = transposed(arm / unit).into_iter().map(|own| own * unit);
        let lengths = [arm / 2.0, 2.0 * arm, second.value].into_iter().chain(digits);
        for own in lengths.filter(|own| *own > 0.0 && (own / arm - 1.0).abs() > 1e-9) {
            let arm_name = [first, point].map(name).concat();
            let how = say!("{} {} for {} {}", arm_name, written(own / unit), written(arm / unit), symbol);
            found.push((point, how, InputChange::Arm { link, end: 2, factor: own / arm, turn: 0.0 }));
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
