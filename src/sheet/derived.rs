//! The last step: what is asked besides the motion of points and links, from what the drawing has told of these.

use std::cell::RefCell;

use super::given::only_translates;
use super::human;
use super::notation::Notation;
use super::rich::Rich;
use super::steps::{Figures, Key};
use crate::graphical::construction::{Act, Calculation, Construction, Label, Reading};
use crate::mechanism::quantity::{Answer, Asked, DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::{Input, LinkId, Mechanism, Path, PointId, Rider, Slide};

const EQUALS: &str = "\u{a0}= ";
const OVER: &str = "\u{a0}/\u{a0}";

/// The sentences of the step; none where everything asked was told before.
#[must_use]
pub fn sentences(
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Vec<Rich> {
    let teller = Teller { construction, n: notation, figures };
    let asked = notation.mechanism().asked.iter().zip(&construction.answers);
    let own = asked.filter(|(asked, _)| asked.method == Method::Polygon);
    let mut all: Vec<Rich> = Vec::new();
    let measured: Vec<Rich> =
        own.clone().filter_map(|(asked, reading)| teller.measured(asked, reading)).collect();
    if !measured.is_empty() {
        let list = Rich::join(&measured, &Rich::upright(notation.words.comma));
        all.push(Rich::fill(notation.words.measured_arms, &[("list", list)]));
    }
    all.extend(own.flat_map(|(asked, reading)| teller.computed(asked, reading)));
    all
}

struct Teller<'a> {
    construction: &'a Construction,
    n: &'a Notation<'a>,
    figures: &'a RefCell<Figures>,
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
            (Quantity::Position(point), Answer::Vector { value, bound })
                if !n.mechanism().is_fixed(point) =>
            {
                let part = |v: f64| human::number(if v.abs() <= *bound { 0.0 } else { v / asked.unit.si });
                let [x, y] = value.map(part);
                let pair = Rich::upright("(").then(&x).up(";\u{a0}").then(&y).up(")");
                Some(symbol.up("\u{a0}").then(&human::with_unit(&pair, &asked.unit.symbol)))
            }
            _ => None,
        }
    }

    /// What follows from rates and vectors that were told.
    fn computed(&self, asked: &Asked, reading: &Reading) -> Vec<Rich> {
        let Answer::Scalar { value, .. } = reading.answer else { return Vec::new() };
        if reading.answer.may_be_zero() {
            return Vec::new();
        }
        let velocity = |l: LinkId| (Quantity::Omega(l), self.omega(l, Order::Velocity));
        let acceleration = |l: LinkId| (Quantity::Alpha(l), self.omega(l, Order::Acceleration));
        match asked.quantity {
            Quantity::Omega(link) => self.companion(link, velocity, &asked.unit).into_iter().collect(),
            Quantity::Alpha(link) => self.companion(link, acceleration, &asked.unit).into_iter().collect(),
            Quantity::RelativeOmega(i, j) => {
                self.difference(asked, value, [velocity(i), velocity(j)]).into_iter().collect()
            }
            Quantity::RelativeAlpha(i, j) => {
                self.difference(asked, value, [acceleration(i), acceleration(j)]).into_iter().collect()
            }
            Quantity::Ratio(i, j) => self.ratio(asked, value, [i, j]).into_iter().collect(),
            Quantity::Advantage(i, j) => self.ratio(asked, value, [j, i]).into_iter().collect(),
            Quantity::PathRadius(point) => self.radius(asked, value, point),
            _ => Vec::new(),
        }
    }

    /// The rate of a link that the steps tell or the scene states.
    fn omega(&self, link: LinkId, order: Order) -> Option<f64> {
        let stated = self.n.mechanism().inputs.iter().find_map(|input| match (input, order) {
            (Input::Angle { link: own, omega, .. }, Order::Velocity) if *own == link => Some(omega.value),
            (
                Input::Angle { link: own, alpha, .. } | Input::Speed { link: own, alpha, .. },
                Order::Acceleration,
            ) if *own == link => Some(alpha.value),
            _ => None,
        });
        stated.or_else(|| self.calculated(link, order))
    }

    fn calculated(&self, link: LinkId, order: Order) -> Option<f64> {
        let acts = self.construction.steps.iter().flat_map(|step| &step.acts);
        acts.filter_map(|act| match act {
            Act::Calculate(calculation) => Some(calculation),
            _ => None,
        })
        .find_map(|calculation| match (calculation, order) {
            (Calculation::Omega { link: own, value, .. }, Order::Velocity)
            | (Calculation::Alpha { link: own, value, .. }, Order::Acceleration)
                if *own == link =>
            {
                Some(*value)
            }
            _ => None,
        })
    }

    /// A rate as it was told; a number that was not told yet is told from now on so.
    fn rate(&self, quantity: Quantity, value: f64) -> Rich {
        let n = self.n;
        let unit = n.angular_unit(quantity.order());
        self.figures.borrow_mut().tell(Key::of(quantity, n), value, &unit)
    }

    /// Link 3 turns with link 4: ω₃ = ω₄.
    fn companion(
        &self,
        link: LinkId,
        rate: impl Fn(LinkId) -> (Quantity, Option<f64>),
        unit: &Unit,
    ) -> Option<Rich> {
        let n = self.n;
        let (own, known) = rate(link);
        if known.is_some() || only_translates(link, n.mechanism(), 0) {
            return None;
        }
        let (other, quantity, value) = turns_with(link, n.mechanism()).into_iter().find_map(|other| {
            let (quantity, value) = rate(other);
            Some((other, quantity, value.filter(|value| *value != 0.0)?))
        })?;
        let told = human::with_unit(&self.rate(quantity, value), &n.angular_unit(quantity.order()).symbol);
        let told = n.with_sense(told, value);
        // In another unit it is another number.
        if *unit != n.angular_unit(quantity.order()) {
            return None;
        }
        let equation =
            n.symbol(own, false).up(EQUALS).then(&n.symbol(quantity, false)).up(EQUALS).then(&told);
        let number = |link: LinkId| Rich::upright(n.number(link));
        let parts = [("link", number(link)), ("other", number(other)), ("equation", equation)];
        Some(Rich::fill(n.words.turns_with, &parts))
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
        if asked.unit != unit {
            return None;
        }
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
            let own = diagram
                .images
                .iter()
                .find(|image| matches!(image.label, Label::Image { point: own, .. } if own == point))?;
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
        let (reading, amount, written) = human::reading_at(normal / scale, factor, normal / unit.si, 0);
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
