//! The last step: what is asked besides the motion of points and links, from what the drawing has told of these.

use std::cell::{Cell, RefCell};

use super::given::only_translates;
use super::human;
use super::notation::Notation;
use super::printed::{Figures, Key, absolute};
use super::reach::Reach;
use super::rich::Rich;
use crate::graphical::construction::{Act, Calculation, Construction, Diagram, Label, Reading};
use crate::graphical::is_a_point;
use crate::mechanism::quantity::{Answer, Asked, DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::{Input, LinkId, Mechanism, Path, PointId, Rider, Slide};

const EQUALS: &str = "\u{a0}= ";
const OVER: &str = "\u{a0}/\u{a0}";

/// The sentences of the step, none where everything asked was told before; and whether they do nothing but tell in other units
/// what was told.
#[must_use]
pub fn sentences(
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> (Vec<Rich>, bool) {
    let teller = Teller { construction, n: notation, figures, conversions: Cell::new(0) };
    let asked = notation.mechanism().asked.iter().zip(&construction.answers);
    let own = asked
        .filter(|(asked, _)| asked.method == Method::Polygon && super::results::is_result(asked, notation));
    let mut all: Vec<Rich> = Vec::new();
    let measured: Vec<Rich> =
        own.clone().filter_map(|(asked, reading)| teller.measured(asked, reading)).collect();
    if !measured.is_empty() {
        let list = Rich::join(&measured, &Rich::upright(notation.words.comma));
        all.push(Rich::fill(notation.words.measured_arms, &[("list", list)]));
    }
    all.extend(own.flat_map(|(asked, reading)| teller.computed(asked, reading)));
    let only_units = teller.conversions.get() == all.len();
    (all, only_units)
}

struct Teller<'a> {
    construction: &'a Construction,
    n: &'a Notation<'a>,
    figures: &'a RefCell<Figures>,
    /// How many sentences tell in another unit what was told.
    conversions: Cell<usize>,
}

/// The link that a link slides on without turning against it, and the other way round.
fn turns_with(link: LinkId, mechanism: &Mechanism) -> Vec<LinkId> {
    let pair = |slide: &Slide| {
        let rider = match slide.rider {
            Rider::Pin { block, .. } => block?,
            Rider::Link { link, .. } => link,
        };
        matches!(slide.guide.path, Path::Straight { .. }).then_some([rider, slide.guide.link])
    };
    let pairs = mechanism.slides.iter().filter_map(pair);
    let other = |[rider, guide]: [LinkId; 2]| match link {
        own if own == rider => Some(guide),
        own if own == guide => Some(rider),
        _ => None,
    };
    pairs.filter_map(other).collect()
}

/// All links that turn with a link because straight guides tie them to each other, the nearest first.
pub(super) fn turning_with(link: LinkId, mechanism: &Mechanism) -> Vec<LinkId> {
    let mut all = vec![link];
    let mut next = 0;
    while let Some(own) = all.get(next).copied() {
        for other in turns_with(own, mechanism) {
            if !all.contains(&other) {
                all.push(other);
            }
        }
        next += 1;
    }
    all.split_off(1)
}

/// Link 3 turns with link 4: ω₃ = ω₄. The one is printed as the other.
pub(super) fn companion(
    [link, other]: [LinkId; 2],
    of: impl Fn(LinkId) -> Quantity,
    value: f64,
    n: &Notation<'_>,
    figures: &mut Figures,
) -> Rich {
    let [own, known] = [link, other].map(of);
    let unit = n.angular_unit(known.order());
    let told = figures.tell(Key::of(known, n), value, &unit);
    figures.alias(Key::of(own, n), Key::of(known, n));
    let told = n.with_sense(human::with_unit(&told, &unit.symbol), value);
    let equation = n.symbol(own, false).up(EQUALS).then(&n.symbol(known, false)).up(EQUALS).then(&told);
    let number = |link: LinkId| Rich::upright(n.number(link));
    let parts = [("link", number(link)), ("other", number(other)), ("equation", equation)];
    Rich::fill(n.words.turns_with, &parts)
}

/// The rate of a link that the steps tell or the scene states.
pub(super) fn known_rate(
    link: LinkId,
    order: Order,
    construction: &Construction,
    mechanism: &Mechanism,
) -> Option<f64> {
    let stated = mechanism.inputs.iter().find_map(|input| match (input, order) {
        (Input::Angle { link: own, omega, .. }, Order::Velocity) if *own == link => Some(omega.value),
        (
            Input::Angle { link: own, alpha, .. } | Input::Speed { link: own, alpha, .. },
            Order::Acceleration,
        ) if *own == link => Some(alpha.value),
        _ => None,
    });
    let acts = || construction.steps.iter().flat_map(|step| &step.acts);
    let calculated = || {
        acts().find_map(|act| match (act, order) {
            (Act::Calculate(Calculation::Omega { link: own, value, .. }), Order::Velocity)
            | (Act::Calculate(Calculation::Alpha { link: own, value, .. }), Order::Acceleration)
                if *own == link =>
            {
                Some(*value)
            }
            _ => None,
        })
    };
    stated.or_else(calculated)
}

/// The images between which a vector lies.
fn ends_of(quantity: Quantity, polygon: &Diagram, mechanism: &Mechanism) -> Option<[Label; 2]> {
    if let Some(vector) = polygon.vectors.iter().find(|vector| vector.quantity == quantity) {
        return Some([vector.tail, vector.head]);
    }
    let image = |point: PointId| polygon.image_of(point, mechanism).map(|image| image.label);
    let under = |point: PointId, link: LinkId| {
        let of = |label: &Label| *label == Label::Image { point, link: Some(link) };
        polygon.images.iter().map(|image| image.label).find(of)
    };
    match quantity {
        Quantity::Velocity(p) | Quantity::Acceleration(p) => Some([Label::Pole, image(p)?]),
        Quantity::CoincidentVelocity(p, l) | Quantity::CoincidentAcceleration(p, l) => {
            Some([Label::Pole, under(p, l)?])
        }
        Quantity::RelativeVelocity(p, q) | Quantity::RelativeAcceleration(p, q) => {
            Some([image(q)?, image(p)?])
        }
        _ => None,
    }
}

/// A rate in another unit of angle or time, as a person reckons it.
fn turned(number: &Rich, ratio: f64) -> Rich {
    use std::f64::consts::{PI, TAU};
    let is = |other: f64| (ratio / other - 1.0).abs() < 1e-9;
    let times = |text: Rich| number.clone().up("\u{a0}×\u{a0}").then(&text);
    if is(60.0 / TAU) {
        times(Rich::upright("60\u{a0}/\u{a0}2π"))
    } else if is(180.0 / PI) {
        times(Rich::upright("180\u{a0}/\u{a0}π"))
    } else if is(1.0 / TAU) {
        number.clone().up("\u{a0}/\u{a0}2π")
    } else {
        times(human::stated(ratio))
    }
}

/// A place that is measured, in the unit in which it is asked.
pub(super) fn place(told: [f64; 2], asked: &Asked) -> Rich {
    let [x, y] = told.map(|v| human::number(v / asked.unit.si));
    let pair = Rich::upright("(").then(&x).up(";\u{a0}").then(&y).up(")");
    human::with_unit(&pair, &asked.unit.symbol)
}

/// The asked centres that were constructed, as they are measured, and those that are not on the paper; nothing where all of
/// them are seen from the pairs.
pub(super) fn centres(construction: &Construction, n: &Notation<'_>) -> Vec<Rich> {
    let Some(reach) = Reach::of_centres(construction, n) else { return Vec::new() };
    let asked = n.mechanism().asked.iter().zip(&construction.answers);
    let told = asked.filter_map(|(asked, reading)| {
        let (Quantity::Centre(i, j), Answer::Vector { value, bound }) = (asked.quantity, &reading.answer)
        else {
            return None;
        };
        let links = crate::plan::chord(i, j);
        let centre = construction.circle.as_ref()?.centre(links)?;
        let symbol = n.symbol(asked.quantity, false).up("\u{a0}");
        (!centre.found.is_primary()).then(|| {
            let place = place(construction.told_place(*value, *bound), asked);
            (reach.lies_beyond(links), symbol.then(&place))
        })
    });
    let (beyond, shown): (Vec<_>, Vec<_>) = told.partition(|(beyond, _)| *beyond);
    let line = |template: &str, told: Vec<(bool, Rich)>| {
        let list: Vec<Rich> = told.into_iter().map(|(_, text)| text).collect();
        (!list.is_empty()).then(|| Rich::fill(template, &[("list", n.list(&list))]))
    };
    let measured = line(n.words.measured_arms, shown);
    measured.into_iter().chain(line(n.words.centres_beyond, beyond)).collect()
}

impl Teller<'_> {
    /// What is measured on the skeleton.
    fn measured(&self, asked: &Asked, reading: &Reading) -> Option<Rich> {
        let n = self.n;
        let symbol = n.symbol(asked.quantity, false);
        let is = |value: &Rich| symbol.clone().up(EQUALS).then(value);
        let stated = |link: LinkId| {
            n.mechanism().inputs.iter().any(|input| match *input {
                Input::Angle { link: own, angle, .. } | Input::Speed { link: own, angle, .. } => {
                    own == link && angle.is_some()
                }
                Input::Slide { .. } => false,
            })
        };
        match (asked.quantity, &reading.answer) {
            (Quantity::Angle(link), _) if stated(link) => None,
            (Quantity::Angle(_) | Quantity::Transmission(..), Answer::Scalar { value, .. }) => {
                Some(is(&human::quantity(*value, &asked.unit)))
            }
            (Quantity::Position(point), Answer::Vector { .. }) if n.mechanism().is_fixed(point) => None,
            (Quantity::Position(_), Answer::Vector { value, bound }) => {
                Some(symbol.up("\u{a0}").then(&place(self.construction.told_place(*value, *bound), asked)))
            }
            _ => None,
        }
    }

    /// What follows from rates and vectors that were told.
    fn computed(&self, asked: &Asked, reading: &Reading) -> Vec<Rich> {
        let value = match reading.answer {
            _ if reading.zero => {
                let lies_square =
                    matches!(asked.quantity, Quantity::Tangential(_) | Quantity::RelativeTangential(..));
                let own = lies_square && !self.figures.borrow().has(Key::of(asked.quantity, self.n));
                return own
                    .then(|| self.n.symbol(asked.quantity, false).up(EQUALS).up("0"))
                    .into_iter()
                    .collect();
            }
            Answer::Scalar { value, .. } => value,
            Answer::Vector { value, .. } => return self.vector(asked, value),
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return Vec::new(),
        };
        let velocity = |l: LinkId| (Quantity::Omega(l), self.omega(l, Order::Velocity));
        let acceleration = |l: LinkId| (Quantity::Alpha(l), self.omega(l, Order::Acceleration));
        let in_asked_unit = || self.in_asked_unit(asked, value, &self.n.angular_unit(asked.quantity.order()));
        match asked.quantity {
            Quantity::Omega(link) | Quantity::Alpha(link) => {
                let told = self.rate(asked, value, link);
                told.into_iter().chain(in_asked_unit()).collect()
            }
            Quantity::RelativeOmega(i, j) => {
                let told = self.difference(asked, value, [velocity(i), velocity(j)]);
                told.into_iter().chain(in_asked_unit()).collect()
            }
            Quantity::RelativeAlpha(i, j) => {
                let told = self.difference(asked, value, [acceleration(i), acceleration(j)]);
                told.into_iter().chain(in_asked_unit()).collect()
            }
            Quantity::Ratio(i, j) => self.ratio(asked, value, [i, j]).into_iter().collect(),
            Quantity::Advantage(i, j) => self.ratio(asked, value, [j, i]).into_iter().collect(),
            Quantity::PathRadius(point) => self.radius(asked, value, point),
            _ => Vec::new(),
        }
    }

    fn omega(&self, link: LinkId, order: Order) -> Option<f64> {
        known_rate(link, order, self.construction, self.n.mechanism())
    }

    /// The rate of a link that no step tells: that of the link with which it turns, or of a block that rides on an arc.
    fn rate(&self, asked: &Asked, value: f64, link: LinkId) -> Option<Rich> {
        let n = self.n;
        let order = asked.quantity.order();
        let has = |link: LinkId| {
            let quantity =
                if order == Order::Acceleration { Quantity::Alpha(link) } else { Quantity::Omega(link) };
            self.figures.borrow().has(Key::of(quantity, n))
        };
        if has(link) || only_translates(link, n.mechanism(), 0) {
            return None;
        }
        let turning = |other: &LinkId| self.omega(*other, order).is_some_and(|value| value != 0.0);
        if let Some(other) = turning_with(link, n.mechanism()).into_iter().find(turning) {
            let value = self.omega(other, order)?;
            let of = |link| {
                if order == Order::Acceleration { Quantity::Alpha(link) } else { Quantity::Omega(link) }
            };
            return Some(companion([link, other], of, value, n, &mut self.figures.borrow_mut()));
        }
        self.on_arc(asked, value, link)
    }

    /// ω₄ = V_B / R of a block on an arc; on one that turns the rate of its link and what the block turns against it.
    fn on_arc(&self, asked: &Asked, value: f64, link: LinkId) -> Option<Rich> {
        let n = self.n;
        let order = asked.quantity.order();
        let (point, guide, radius) =
            n.mechanism().slides.iter().find_map(|slide| match (slide.rider, slide.guide.path) {
                (Rider::Pin { point, block: Some(block) }, Path::Arc { radius, .. }) if block == link => {
                    Some((point, slide.guide.link, radius.value))
                }
                _ => None,
            })?;
        let rests = only_translates(guide, n.mechanism(), 0);
        let base = if rests { 0.0 } else { self.omega(guide, order)? };
        let (along, of_guide) = match order {
            Order::Acceleration => (Quantity::SlipTangential(point, guide), Quantity::Alpha(guide)),
            _ if guide == LinkId::FRAME => (Quantity::Velocity(point), Quantity::Omega(guide)),
            _ => (Quantity::Slip(point, guide), Quantity::Omega(guide)),
        };
        let (unit, w, length) = (n.unit(order.dimension()), n.angular_unit(order), &n.scene.units.length);
        if (unit.si / length.si / w.si - 1.0).abs() > 1e-9 {
            return None;
        }
        let against = value - base;
        let quotient = (Some(Key::of(along, n)), against.abs() * radius, &unit);
        let turning = (Some(Key::of(of_guide, n)), base, &w);
        let own = (None, radius, length);
        let result = (Some(Key::of(asked.quantity, n)), value.abs(), &w);
        let sign = if against < 0.0 { "\u{a0}−\u{a0}" } else { "\u{a0}+\u{a0}" };
        let ratio = |a: &Rich, b: &Rich| a.clone().up(OVER).then(b);
        let symbols = ratio(&n.symbol(along, false), &Rich::italic("R"));
        let mut figures = self.figures.borrow_mut();
        let (symbols, numbers, result) = if base == 0.0 {
            let (numbers, result, _) = figures.line_of(&[quotient, own], result, |x| x[0] / x[1]);
            (symbols, ratio(&numbers[0], &numbers[1]), result)
        } else {
            let (numbers, result, _) = figures.line_of(&[turning, quotient, own], result, |x| {
                (x[0].copysign(base) + (x[1] / x[2]).copysign(against)).abs()
            });
            let minus = if base < 0.0 { "−" } else { "" };
            let sum = Rich::upright(minus).then(&numbers[0]).up(sign).then(&ratio(&numbers[1], &numbers[2]));
            let result = if value < 0.0 { Rich::upright("−").then(&result) } else { result };
            (n.symbol(of_guide, false).up(sign).then(&symbols), sum, result)
        };
        let told = human::with_unit(&result, &w.symbol);
        let told = if base == 0.0 { n.with_sense(told, value) } else { told };
        let text = n.symbol(asked.quantity, false).up(EQUALS).then(&symbols).up(EQUALS).then(&numbers);
        Some(text.up(EQUALS).then(&told))
    }

    /// A vector that no step has read, and one that is asked in another unit than the drawing's.
    fn vector(&self, asked: &Asked, [x, y]: [f64; 2]) -> Vec<Rich> {
        let n = self.n;
        let order = super::results::polygon_of(asked.quantity);
        let Some(polygon) = self.construction.diagram(order.diagram()) else { return Vec::new() };
        let (unit, size) = (n.unit(order.dimension()), libm::hypot(x, y));
        let key = Key::of(asked.quantity, n);
        let mut all = Vec::new();
        let symbol = n.symbol(asked.quantity, false);
        if !self.figures.borrow().has(key)
            && let Some(ends) = ends_of(asked.quantity, polygon, n.mechanism())
                .or_else(|| ends_of(absolute(asked.quantity, n), polygon, n.mechanism()))
        {
            let mm = size / polygon.si_per_mm;
            let on_paper = (mm, is_a_point(mm));
            let told = (&mut *self.figures.borrow_mut(), key);
            all.push(super::steps::read(symbol.clone(), ends, on_paper, size, polygon, n, told));
        }
        all.extend(self.in_asked_unit(asked, size, &unit));
        all
    }

    /// A size that was told in the unit of the drawing, in the one in which it is asked for: ω₃ = 5.47 × 60 / 2π = 52.2 rpm.
    fn in_asked_unit(&self, asked: &Asked, size: f64, unit: &Unit) -> Option<Rich> {
        let n = self.n;
        let key = Key::of(asked.quantity, n);
        if asked.unit == *unit || !self.figures.borrow().has(key) {
            return None;
        }
        self.conversions.set(self.conversions.get() + 1);
        let ratio = unit.si / asked.unit.si;
        let (numbers, result, _) = self.figures.borrow_mut().line_of(
            &[(Some(key), size, unit)],
            (None, size.abs(), &asked.unit),
            |x| x[0] * ratio,
        );
        let told = human::with_unit(&result, &asked.unit.symbol);
        let line = n.symbol(asked.quantity, false).up(EQUALS);
        Some(match asked.quantity {
            Quantity::Omega(_) | Quantity::Alpha(_) => {
                line.then(&turned(&numbers[0], ratio)).up(EQUALS).then(&n.with_sense(told, size))
            }
            Quantity::RelativeOmega(..) | Quantity::RelativeAlpha(..) => {
                let minus = if size < 0.0 { "−" } else { "" };
                line.up(minus).then(&turned(&numbers[0], ratio)).up(EQUALS).up(minus).then(&told)
            }
            _ => line.then(&human::with_unit(&numbers[0], &unit.symbol)).up(EQUALS).then(&told),
        })
    }

    /// ω₃₂ = ω₃ − ω₂, counter-clockwise positive.
    fn difference(
        &self,
        asked: &Asked,
        value: f64,
        [(first, a), (second, b)]: [(Quantity, Option<f64>); 2],
    ) -> Option<Rich> {
        let n = self.n;
        let (a, b) = (a?, b?);
        let unit = n.angular_unit(asked.quantity.order());
        let of = |quantity: Quantity, value: f64| (Some(Key::of(quantity, n)), value, &unit);
        let (numbers, result, _) = self.figures.borrow_mut().line_of(
            &[of(first, a), of(second, b)],
            (Some(Key::of(asked.quantity, n)), value.abs(), &unit),
            |x| (x[0].copysign(a) - x[1].copysign(b)).abs(),
        );
        let sign =
            |value: f64, plain: &'static str, minus: &'static str| if value < 0.0 { minus } else { plain };
        let written = Rich::upright(sign(a, "", "−"))
            .then(&numbers[0])
            .up(sign(b, "\u{a0}− ", "\u{a0}+ "))
            .then(&numbers[1]);
        let result = Rich::upright(sign(value, "", "−")).then(&human::with_unit(&result, &unit.symbol));
        let text = n.symbol(asked.quantity, false).up(EQUALS).then(&n.symbol(first, false)).up("\u{a0}− ");
        Some(text.then(&n.symbol(second, false)).up(EQUALS).then(&written).up(EQUALS).then(&result))
    }

    /// ω₄/ω₂, and T₄/T₂ = ω₂/ω₄.
    fn ratio(&self, asked: &Asked, value: f64, links: [LinkId; 2]) -> Option<Rich> {
        let n = self.n;
        let [a, b] = links.map(|link| self.omega(link, Order::Velocity));
        let (a, b) = (a?, b?);
        let [first, second] = links.map(Quantity::Omega);
        let (w, none) = (n.angular_unit(Order::Velocity), &asked.unit);
        let of = |quantity: Quantity, value: f64| (Some(Key::of(quantity, n)), value, &w);
        let (numbers, result, _) = self.figures.borrow_mut().line_of(
            &[of(first, a), of(second, b)],
            (Some(Key::of(asked.quantity, n)), value.abs(), none),
            |x| x[0] / x[1],
        );
        let minus = if value < 0.0 { "−" } else { "" };
        let symbols = n.symbol(first, false).up(OVER).then(&n.symbol(second, false));
        let own = n.symbol(asked.quantity, false);
        let text = match asked.quantity {
            Quantity::Ratio(..) => own,
            _ => own.up(EQUALS).then(&symbols),
        };
        let numbers = Rich::upright(minus).then(&numbers[0]).up(OVER).then(&numbers[1]);
        Some(text.up(EQUALS).then(&numbers).up(EQUALS).up(minus).then(&result))
    }

    /// ρ = V² / Aⁿ with the part of the acceleration that is square to the velocity.
    fn radius(&self, asked: &Asked, value: f64, point: PointId) -> Vec<Rich> {
        let n = self.n;
        let vector = |kind: DiagramKind| {
            let diagram = self.construction.diagram(kind)?;
            let own = diagram.image_of(point, n.mechanism())?;
            Some((own.at.map(|x| x * diagram.si_per_mm), diagram.si_per_mm))
        };
        let velocity = vector(DiagramKind::Velocity);
        let Some(((v, _), (_, scale))) = velocity.zip(vector(DiagramKind::Acceleration)) else {
            return Vec::new();
        };
        let speed = libm::hypot(v[0], v[1]);
        let normal = speed * speed / value.abs();
        let (unit, length) = (n.unit(Dimension::Acceleration), &asked.unit);
        let v_unit = n.unit(Dimension::Velocity);
        let factor = scale / unit.si;
        // Read with a figure more where the radius of curvature, which is told already, needs it.
        let square = speed * speed / length.si;
        let read = |more: usize| human::reading_at(normal / scale, factor, normal / unit.si, more);
        let told = human::finer(value.abs() / length.si, 0).1;
        let closes = |(_, _, written): &(Rich, Rich, f64)| {
            human::agrees(square / (written * unit.si), told, value.abs() / length.si, 0)
        };
        let (reading, amount, written) = (0..=1).map(read).find(closes).unwrap_or_else(|| read(1));
        let reading = reading
            .up("\u{a0}×\u{a0}")
            .then(&human::stated(factor))
            .up(EQUALS)
            .then(&human::with_unit(&amount, &unit.symbol));
        let [of, to] = [Quantity::Acceleration(point), Quantity::Velocity(point)];
        let parts =
            [("acceleration", n.symbol(of, false)), ("velocity", n.symbol(to, false)), ("reading", reading)];
        let read = Rich::fill(n.words.square_part, &parts);
        let (numbers, result, _) = self.figures.borrow_mut().line_of(
            &[(Some(Key::of(to, n)), speed, &v_unit)],
            (Some(Key::of(asked.quantity, n)), value.abs(), length),
            |x| (x[0] * v_unit.si) * (x[0] * v_unit.si) / (written * unit.si) / length.si,
        );
        let rho = n.symbol(asked.quantity, false).up(EQUALS).then(&numbers[0]).up("²").up(OVER).then(&amount);
        vec![read, rho.up(EQUALS).then(&human::with_unit(&result, &length.symbol))]
    }
}
