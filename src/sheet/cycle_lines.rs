//! The lines of a turning-moment diagram: every number from those before it. Of curves by tables an area is a sum of
//! trapezia, of curves by waves the difference of an integral at two angles; any other is measured on the diagram.

use std::cell::RefCell;

use super::cycle::{TOLD, energy_unit, height, paper_of, symbol};
use super::human;
use super::notation::Notation;
use super::printed::{Figures, Key};
use super::rich::Rich;
use super::steps::in_radians;
use super::waves::{Waves, rounded};
use crate::graphical::cycle::CycleSheet;
use crate::mechanism::Input;
use crate::mechanism::curve::Curve;
use crate::mechanism::cycle::{Course, Cycle, CycleQuantity, Rotating, RotatingInertia, Sides};
use crate::mechanism::quantity::{Answer, Order, Quantity, Unit};

/// The lines in which the numbers of the diagram are computed, each from those before it.
pub(super) struct Computed<'a> {
    pub(super) sheet: &'a CycleSheet,
    pub(super) notation: &'a Notation<'a>,
    pub(super) figures: &'a RefCell<Figures>,
}

/// A number of such a line: its symbol, its key where it stands elsewhere too, its value, SI, and its unit: an SI unit, or
/// one of the scene.
type Factor = (Rich, Option<Key>, f64, &'static str);

/// The scene's unit of a torque, and that of an energy.
const TORQUE: &str = "torque of the scene";
const ENERGY: &str = "energy of the scene";

impl Computed<'_> {
    fn number(&self, of: CycleQuantity, unit: &'static str) -> Option<Factor> {
        let Answer::Scalar { value, .. } = self.sheet.answer(of) else { return None };
        Some((symbol(self.notation, of), Some(Key::Of(Quantity::Cycle(of))), value, unit))
    }

    /// A unit by its SI symbol, or the scene's.
    fn unit(&self, name: &'static str) -> Unit {
        let torque = &self.notation.scene.units.torque;
        match name {
            TORQUE => torque.clone(),
            ENERGY => Unit { symbol: energy_unit(&torque.symbol), si: torque.si },
            si => Unit { symbol: si.to_owned(), si: 1.0 },
        }
    }

    /// A line whose result stands in lines with numbers of other kinds: there units of SI go together, and this is it.
    fn also(&self, line: Rich, key: Key, value: f64, unit: &'static str) -> Rich {
        let own = self.unit(if unit == "J" { ENERGY } else { TORQUE });
        let unit = self.unit(unit);
        if own == unit {
            return line;
        }
        let mut figures = self.figures.borrow_mut();
        let Some(printed) = figures.print_of(key).map(super::printed::Print::si) else { return line };
        let (text, number) = human::in_common(printed.abs(), value.abs(), figures.more(key));
        figures.note_also(key, &text, (number, value.abs()), &unit);
        line.up("\u{a0}= ")
            .up(if value < 0.0 { "−" } else { "" })
            .then(&human::with_unit(&text, &unit.symbol))
    }

    /// A line in units of SI whose result somebody asks in another one.
    fn as_asked(&self, line: Rich, of: CycleQuantity, value: f64) -> Rich {
        let all = &self.notation.mechanism().asked;
        let asked = all.iter().find(|asked| asked.quantity == Quantity::Cycle(of));
        let Some(unit) = asked.map(|asked| &asked.unit).filter(|unit| unit.si != 1.0) else { return line };
        let key = key(of);
        let mut figures = self.figures.borrow_mut();
        let Some(printed) = figures.print_of(key).map(super::printed::Print::si) else { return line };
        let (printed, exact) = (printed.abs() / unit.si, value.abs() / unit.si);
        let tens = libm::log10(unit.si);
        let text = if (tens - libm::round(tens)).abs() < 1e-9 {
            // Of so many tens of the other unit it has the same figures.
            figures.tell(key, value, unit)
        } else {
            let (text, number) = human::in_common(printed, exact, figures.more(key));
            figures.note_also(key, &text, (number, exact), unit);
            text
        };
        line.up("\u{a0}= ")
            .up(if value < 0.0 { "−" } else { "" })
            .then(&human::with_unit(&text, &unit.symbol))
    }

    fn cycle(&self) -> Option<&Cycle> {
        self.notation.mechanism().forces.cycle.as_ref()
    }

    /// Those of the mean torque, of the areas and levels, and those that follow from the levels.
    pub(super) fn lines(&self) -> (Vec<Rich>, Option<Vec<Rich>>, Vec<Rich>) {
        let mechanism = self.notation.mechanism();
        let Some(cycle) = self.cycle() else { return (Vec::new(), None, Vec::new()) };
        let asked = |of: CycleQuantity| {
            mechanism.asked.iter().any(|asked| match asked.quantity {
                Quantity::Cycle(other) => other == of || other.computed_from().contains(&of),
                _ => false,
            })
        };
        let period = || Some((Rich::italic("θ").sub("C"), Some(Key::Given("θ_C")), cycle.period.value, ""));
        let (speed, key) = speed(self.notation);
        let omega = || Some((speed.clone(), Some(key), cycle.omega.value.abs(), "rad/s"));
        let wanted = || {
            let given = cycle.fluctuation?;
            Some((symbol(self.notation, CycleQuantity::OfSpeed), None, given.value, ""))
        };
        let of = |quantity, unit| self.number(quantity, unit);
        let (minus, over, times) = (" −\u{a0}", "\u{a0}/\u{a0}", "\u{a0}×\u{a0}");
        let turns = if matches!(key, Key::Given(_)) { self.speed_in_radians() } else { None };
        // With a speed or an inertia units of SI go together.
        let in_si = asked(CycleQuantity::Power);
        let key_of = |of: CycleQuantity| Key::Of(Quantity::Cycle(of));
        let mean = [
            Some(self.added_up()),
            // Waves have no mean of their own: what remains is the constant.
            (asked(CycleQuantity::Work) || asked(CycleQuantity::Mean)).then(|| {
                let (name, key, value, unit) = self.number(CycleQuantity::Mean, TORQUE)?;
                let unit = self.unit(unit);
                self.constant()?;
                let told = self.figures.borrow_mut().tell(key?, value, &unit);
                let sign = if value < 0.0 { "−" } else { "" };
                let sum = name.up("\u{a0}= (1\u{a0}/\u{a0}").it("θ").sub("C").up(")\u{a0}∫\u{a0}").it("T");
                let sum = sum.up("\u{a0}d").it("θ").up("\u{a0}= ").up(sign);
                let line = sum.then(&human::with_unit(&told, &unit.symbol));
                Some(if in_si { self.also(line, key?, value, "N*m") } else { line })
            }),
            (asked(CycleQuantity::Work) && self.constant().is_some()).then(|| {
                let factors = [of(CycleQuantity::Mean, TORQUE)?, period()?];
                let set = |n: &[Rich]| n[0].clone().up(times).then(&n[1]);
                self.line(of(CycleQuantity::Work, ENERGY)?, &factors, set, |n| n[0] * n[1])
            }),
            asked(CycleQuantity::Work).then(|| self.work()),
            (asked(CycleQuantity::Mean) && self.constant().is_none()).then(|| {
                let factors = [of(CycleQuantity::Work, ENERGY)?, period()?];
                let set = |n: &[Rich]| n[0].clone().up(over).then(&n[1]);
                let mean = of(CycleQuantity::Mean, TORQUE)?;
                let value = mean.2;
                let line = self.line(mean, &factors, set, |n| n[0] / n[1])?;
                Some(if in_si { self.also(line, key_of(CycleQuantity::Mean), value, "N*m") } else { line })
            }),
            asked(CycleQuantity::Power).then(|| {
                let factors = [of(CycleQuantity::Mean, "N*m")?, omega()?];
                let set = |n: &[Rich]| n[0].clone().up(times).then(&n[1]);
                let power = of(CycleQuantity::Power, "W")?;
                let value = power.2;
                let line = self.line(power, &factors, set, |n| n[0] * n[1])?;
                Some(self.as_asked(line, CycleQuantity::Power, value))
            }),
        ];
        let areas = self.areas();
        let rest = [
            asked(CycleQuantity::Fluctuation).then(|| {
                let factors = [of(CycleQuantity::Highest, ENERGY)?, of(CycleQuantity::Lowest, ENERGY)?];
                let set = |n: &[Rich]| n[0].clone().up(minus).then(&n[1]);
                let fluctuation = of(CycleQuantity::Fluctuation, ENERGY)?;
                let value = fluctuation.2;
                let line = self.line(fluctuation, &factors, set, |n| n[0] - n[1])?;
                let in_si = asked(CycleQuantity::OfSpeed) || asked(CycleQuantity::Flywheel);
                Some(if in_si {
                    self.also(line, key_of(CycleQuantity::Fluctuation), value, "J")
                } else {
                    line
                })
            }),
            asked(CycleQuantity::OfEnergy).then(|| {
                let (name, key, work, unit) = of(CycleQuantity::Work, ENERGY)?;
                let bars = |name: Rich| Rich::upright("|").then(&name).up("|");
                let name = if work < 0.0 { bars(name) } else { name };
                let factors = [of(CycleQuantity::Fluctuation, ENERGY)?, (name, key, work.abs(), unit)];
                let set = |n: &[Rich]| n[0].clone().up(over).then(&n[1]);
                self.line(of(CycleQuantity::OfEnergy, "")?, &factors, set, |n| n[0] / n[1])
            }),
            asked(CycleQuantity::Inertia).then(|| self.inertia()),
            asked(CycleQuantity::Flywheel).then(|| {
                let mut factors = vec![of(CycleQuantity::Fluctuation, "J")?, wanted()?, omega()?];
                factors.extend(of(CycleQuantity::Inertia, "kg*m^2").filter(|(_, _, value, _)| *value != 0.0));
                let set = |n: &[Rich]| {
                    let first = n[0].clone().up(over).up("(").then(&n[1]).up(times).then(&n[2]).up("²)");
                    n.get(3).map_or_else(|| first.clone(), |own| first.clone().up(minus).then(own))
                };
                let reckon = |n: &[f64]| {
                    let needed = n[0] / (n[1] * n[2] * n[2]);
                    n.get(3).map_or(needed, |own| needed - own)
                };
                let flywheel = of(CycleQuantity::Flywheel, "kg*m^2")?;
                let value = flywheel.2;
                let line = self.line(flywheel, &factors, set, reckon)?;
                Some(self.as_asked(line, CycleQuantity::Flywheel, value))
            }),
            asked(CycleQuantity::OfSpeed).then(|| {
                let mut factors = vec![of(CycleQuantity::Fluctuation, "J")?, omega()?];
                // With the flywheel that is still needed.
                factors.extend(self.turning()?);
                let set = |n: &[Rich]| {
                    let turns = match n.get(3) {
                        Some(flywheel) => {
                            Rich::upright("(").then(&n[2]).up("\u{a0}+\u{a0}").then(flywheel).up(")")
                        }
                        None => n[2].clone(),
                    };
                    n[0].clone().up(over).up("(").then(&turns).up(times).then(&n[1]).up("²)")
                };
                let reckon = |n: &[f64]| n[0] / (n[2..].iter().sum::<f64>() * n[1] * n[1]);
                self.line(of(CycleQuantity::OfSpeed, "")?, &factors, set, reckon)
            }),
            asked(CycleQuantity::AtMost).then(|| self.steepest(CycleQuantity::AtMost)),
            asked(CycleQuantity::Most).then(|| self.fastest(CycleQuantity::Most, CycleQuantity::AtMost)),
            asked(CycleQuantity::AtLeast).then(|| self.steepest(CycleQuantity::AtLeast)),
            asked(CycleQuantity::Least).then(|| self.fastest(CycleQuantity::Least, CycleQuantity::AtLeast)),
        ];
        (
            turns.into_iter().chain(mean.into_iter().flatten().flatten()).collect(),
            areas,
            rest.into_iter().flatten().flatten().collect(),
        )
    }

    /// The corners of a course, or of the difference of both, over one period, radians and N m, where it is straight between
    /// them; and whether they stand so in the scene.
    fn corners(&self, of: Of) -> Option<(Vec<[f64; 2]>, bool)> {
        let cycle = self.cycle()?;
        let straight = |course: &Course| matches!(course, Course::Curve(Curve::Table { .. }));
        let [torque, load] = &self.sheet.curves;
        let (curve, course) = match (&cycle.sides, of) {
            (Sides::Torque(course), _) => (torque.clone(), Some(course)),
            (Sides::Load(course), _) => (load.clone(), Some(course)),
            (Sides::Both { torque: course, .. }, Of::Torque) => (torque.clone(), Some(course)),
            (Sides::Both { torque: one, load: other }, Of::Net) if straight(one) && straight(other) => {
                (net(torque, load), None)
            }
            _ => return None,
        };
        if !course.is_none_or(straight) || curve.is_empty() {
            return None;
        }
        if let (Some(Course::Curve(Curve::Table { knots, .. })), 1) = (course, cycle.copies.number) {
            let knots: Vec<[f64; 2]> = knots.iter().map(|knot| knot.map(|given| given.value)).collect();
            let whole = knots
                .first()
                .zip(knots.last())
                .is_some_and(|(first, last)| first[0] == 0.0 && (last[0] - cycle.period.value).abs() < 1e-9);
            if whole && !self.sheet.falling {
                return (knots.len() <= TOLD).then_some((knots, true));
            }
        }
        let knots = only_corners(curve);
        (knots.len() <= TOLD).then_some((knots, false))
    }

    /// What is added up before anything is computed: the curves of several cylinders, or a torque and its load.
    fn added_up(&self) -> Option<Rich> {
        let cycle = self.cycle()?;
        let n = self.notation;
        let equals = "\u{a0}= ";
        let torque = &n.scene.units.torque;
        let mut told = Vec::new();
        let names = |of: Of| match (&cycle.sides, of) {
            (Sides::Load(_), _) => Rich::italic("T").sub("l"),
            (Sides::Both { .. }, Of::Net) => Rich::italic("T").up(" −\u{a0}").it("T").sub("l"),
            _ => Rich::italic("T"),
        };
        if let Some([waves, _]) = self.waves().filter(|_| cycle.copies.number > 1) {
            let of = if matches!(cycle.sides, Sides::Load(_)) { Of::Net } else { Of::Torque };
            let sum = Rich::upright("(").then(&waves.told(torque.si, human::number)).up(")");
            let sum = human::with_unit(&sum, &torque.symbol);
            return Some(Rich::upright("Σ\u{a0}").then(&names(of)).up(equals).then(&sum));
        }
        for of in [Of::Torque, Of::Net] {
            let both = matches!(cycle.sides, Sides::Both { .. });
            if of == Of::Torque && both && cycle.copies.number == 1 || of == Of::Net && !both {
                continue;
            }
            let Some((knots, false)) = self.corners(of) else { continue };
            // A table that begins later or comes again is that which is given.
            if cycle.copies.number == 1 && !both {
                continue;
            }
            let name =
                if cycle.copies.number > 1 { Rich::upright("Σ\u{a0}").then(&names(of)) } else { names(of) };
            let knot = |[at, size]: &[f64; 2]| {
                let angle = human::degrees(*at);
                let size = human::given(size / torque.si, 0).0;
                Rich::upright("(").then(&angle).up(";\u{a0}").then(&size).up(")")
            };
            let list: Vec<Rich> = knots.iter().map(knot).collect();
            let list = human::with_unit(&Rich::join(&list, &Rich::upright(" ")), &torque.symbol);
            told.push(name.up(":\u{a0}").then(&list));
        }
        (!told.is_empty()).then(|| Rich::join(&told, &Rich::upright(n.words.comma)))
    }

    /// A sum of trapezoids under a line, in the scene's unit of torque and degrees, and what it comes to.
    fn sum(&self, name: Rich, points: &[[f64; 2]], (key, value): (Key, f64)) -> Rich {
        let joule = self.unit(ENERGY);
        let parts = points.windows(2).map(|pair| {
            let [[a, low], [b, high]] = [pair[0], pair[1]];
            0.5 * (low + high) / joule.si * (b - a).to_degrees()
        });
        let parts: Vec<f64> = parts.collect();
        let largest = parts.iter().fold(0.0, |most: f64, part| most.max(part.abs()));
        let parts: Vec<f64> = parts.into_iter().filter(|part| part.abs() > 1e-9 * largest).collect();
        let plain = self.unit("");
        if parts.is_empty() {
            let zero = self.figures.borrow_mut().tell(key, 0.0, &joule);
            return name.up("\u{a0}= ").then(&human::with_unit(&zero, &joule.symbol));
        }
        let factors: Vec<(Option<Key>, f64, &Unit)> =
            parts.iter().map(|part| (None, *part, &plain)).collect();
        let reckon = |numbers: &[f64]| {
            let sum: f64 = numbers.iter().zip(&parts).map(|(number, part)| number.copysign(*part)).sum();
            sum.to_radians().abs()
        };
        // A number stands in other lines without its sign.
        let told = (Some(key), value.abs(), &joule);
        let (numbers, text, _) = self.figures.borrow_mut().line_from(&factors, told, reckon);
        let mut sum = Rich::default();
        for (index, (number, part)) in numbers.iter().zip(&parts).enumerate() {
            let sign = match (index, *part < 0.0) {
                (0, false) => "",
                (0, true) => "−",
                (_, false) => " +\u{a0}",
                (_, true) => " −\u{a0}",
            };
            sum = sum.up(sign).then(number);
        }
        let sum = match parts[..] {
            [one] if one > 0.0 => sum,
            _ => Rich::upright("(").then(&sum).up(")"),
        };
        let line = name.up("\u{a0}= ").then(&sum).up("\u{a0}×\u{a0}π\u{a0}/\u{a0}180\u{a0}= ");
        line.up(if value < 0.0 { "−" } else { "" }).then(&human::with_unit(&text, &joule.symbol))
    }

    /// The constant of a sum of waves over whole periods, which is its mean.
    fn constant(&self) -> Option<f64> {
        let cycle = self.cycle()?;
        let (Sides::Torque(course) | Sides::Load(course) | Sides::Both { torque: course, .. }) = &cycle.sides
        else {
            return None;
        };
        let Course::Curve(Curve::Harmonics { constant, .. }) = course else { return None };
        let Answer::Scalar { value, .. } = self.sheet.answer(CycleQuantity::Mean) else { return None };
        let all = constant.value * f64::from(cycle.copies.number);
        ((value - all).abs() <= 1e-6 * value.abs()).then_some(value)
    }

    /// The torque that is known and the difference of the two as sums of waves: the latter without a constant.
    fn waves(&self) -> Option<[Waves; 2]> {
        let cycle = self.cycle()?;
        let of = |course: &Course| match course {
            Course::Curve(curve) => Waves::of(curve, cycle),
            Course::Of(_) => None,
        };
        let (known, mut net) = match &cycle.sides {
            Sides::Torque(torque) => (of(torque)?, of(torque)?),
            Sides::Load(load) => (of(load)?, of(load)?.times(-1.0)),
            Sides::Both { torque, load } => (of(torque)?, of(torque)?.plus(of(load)?.times(-1.0))),
            Sides::Areas { .. } => return None,
        };
        if matches!(cycle.sides, Sides::Both { .. }) {
            if net.constant.abs() > 1e-9 * known.constant.abs() {
                return None;
            }
        } else {
            self.constant()?;
        }
        net.constant = 0.0;
        Some([known, net])
    }

    /// Areas of the paper by their scales: A = 3.25 · 150 · 12°, the angle in radians.
    fn planimeter(&self) -> Option<Vec<Rich>> {
        let cycle = self.notation.mechanism().forces.cycle.as_ref()?;
        let Sides::Areas { areas, torque, angle, .. } = &cycle.sides else { return None };
        if areas.len() > TOLD || areas.len() != self.sheet.areas.len() {
            return None;
        }
        let lines = areas.iter().zip(&self.sheet.areas).zip(1_u32..).map(|((area, value), k)| {
            let of = CycleQuantity::Area(k);
            let key = Some(Key::Of(Quantity::Cycle(of)));
            let factors = [area.value, torque.value, angle.value];
            self.by_scales(symbol(self.notation, of), factors, "", (key, *value))
        });
        Some(lines.collect())
    }

    /// An area of the paper by the scales of torque and angle.
    fn by_scales(
        &self,
        name: Rich,
        factors: [f64; 3],
        of_paper: &str,
        (key, value): (Option<Key>, f64),
    ) -> Rich {
        let unit = |symbol: &str, si: f64| Unit { symbol: symbol.to_owned(), si };
        let (plain, joule) = (unit("", 1.0), self.unit(ENERGY));
        let [area, torque, angle] = factors;
        let factors = [area, torque / joule.si, angle];
        let degrees = unit("°", std::f64::consts::PI / 180.0);
        let units = [&plain, &plain, &degrees];
        let told: Vec<(Option<Key>, f64, &Unit)> =
            factors.iter().zip(units).map(|(factor, unit)| (None, *factor, unit)).collect();
        let reckon = |n: &[f64]| n.iter().product::<f64>().to_radians();
        let result = (key, value.abs(), &joule);
        let (mut numbers, text, _) = self.figures.borrow_mut().line_from(&told, result, reckon);
        numbers[0] = human::with_unit(&numbers[0], of_paper);
        let sign = if value < 0.0 { "−" } else { "" };
        let product = Rich::join(&numbers, &Rich::upright("\u{a0}×\u{a0}"));
        let line = name.up("\u{a0}= ").up(sign).then(&product).up("\u{a0}×\u{a0}π\u{a0}/\u{a0}180\u{a0}= ");
        line.up(sign).then(&human::with_unit(&text, &joule.symbol))
    }

    /// The angles at which the two sides are equal.
    fn where_they_cross(&self) -> Option<Rich> {
        let all = &self.sheet.crossings;
        if all.is_empty() || all.len() > TOLD {
            return None;
        }
        let degree = Unit { symbol: "°".to_owned(), si: std::f64::consts::PI / 180.0 };
        let mut figures = self.figures.borrow_mut();
        let told: Vec<Rich> = all
            .iter()
            .zip(1_u32..)
            .map(|(crossing, k)| {
                let of = CycleQuantity::Crossing(k);
                let angle = figures.tell(Key::Of(Quantity::Cycle(of)), crossing.at, &degree);
                symbol(self.notation, of).up("\u{a0}=\u{a0}").then(&angle).up("°")
            })
            .collect();
        let sides = match self.sheet.constant {
            Some(0) => Rich::italic("T").sub("l").up("\u{a0}=\u{a0}").it("T").sub("m"),
            Some(_) => Rich::italic("T").up("\u{a0}=\u{a0}").it("T").sub("m"),
            None => Rich::italic("T").up("\u{a0}=\u{a0}").it("T").sub("l"),
        };
        // Of waves the equation whose roots they are.
        let equation = self.waves().map(|[_, net]| {
            let torque = self.notation.scene.units.torque.si;
            sides.clone().up(" ⇒\u{a0}").then(&net.told(torque, rounded)).up("\u{a0}= 0")
        });
        let sides = equation.unwrap_or(sides);
        Some(sides.up(":\u{a0}").then(&Rich::join(&told, &Rich::upright(self.notation.words.comma))).up("."))
    }

    /// E = Σ ½ (T + T′) Δθ; of an area of the paper by its scales.
    fn work(&self) -> Option<Rich> {
        if self.constant().is_some() {
            return None;
        }
        let (name, key, value, _) = self.number(CycleQuantity::Work, ENERGY)?;
        let sides = &self.notation.mechanism().forces.cycle.as_ref()?.sides;
        if let Sides::Areas { torque, angle, total: Some(total), .. } = sides {
            return Some(self.by_scales(name, [total.value, torque.value, angle.value], "", (key, value)));
        }
        let Some((knots, _)) = self.corners(Of::Torque) else {
            return Some(self.measured(name, (key?, value)));
        };
        let formula =
            name.up("\u{a0}= Σ\u{a0}½\u{a0}(").it("T").up("\u{a0}+\u{a0}").it("T").up("′)\u{a0}Δ").it("θ");
        Some(self.sum(formula, &knots, (key?, value)))
    }

    /// An area measured on the diagram as it is drawn, by the scales of torque and angle: cm², of a small one mm².
    fn measured(&self, name: Rich, (key, value): (Key, f64)) -> Rich {
        /// Less of a square centimetre is small.
        const SMALL: f64 = 0.1;
        let [torque, angle] = paper_of(self.sheet, self.notation);
        let mm2 = value.abs() / (torque * angle);
        let (per, unit) = if mm2 < 100.0 * SMALL { (1.0, "mm^2") } else { (10.0, "cm^2") };
        let factors = [mm2 / (per * per), per * torque, per * angle];
        self.by_scales(name, factors, unit, (Some(key), value))
    }

    /// I = Σ M ρ² (ω′/ω)² of what turns with the input.
    fn inertia(&self) -> Option<Rich> {
        let cycle = self.cycle()?;
        let several = cycle.rotating.len() > 1;
        let alone =
            |of: &Rotating| matches!(of.inertia, RotatingInertia::Central(_)) && of.ratio.value == 1.0;
        if !several && cycle.rotating.first().is_none_or(alone) {
            return None;
        }
        let g = self.notation.mechanism().forces.gravity.g.value;
        let speed = speed(self.notation).0;
        // Each factor with the sign before it and how often it counts.
        let (mut factors, mut signs) = (Vec::new(), Vec::new());
        for (index, rotating) in cycle.rotating.iter().enumerate() {
            let sub = if several { (index + 1).to_string() } else { String::new() };
            let named = |letter: &str| Rich::italic(letter).sub(&sub);
            let mut push =
                |symbol: Rich, value: f64, unit: &'static str, sign: &'static str, square: bool| {
                    factors.push((symbol, None, value, unit));
                    signs.push((sign, square));
                };
            let first = if index > 0 { " +\u{a0}" } else { "" };
            match rotating.inertia {
                RotatingInertia::Central(inertia) => {
                    push(own_inertia(cycle, &sub, rotating), inertia.value, "kg*m^2", first, false);
                }
                RotatingInertia::Mass(mass, radius) => {
                    push(named("M"), mass.value, "kg", first, false);
                    push(named("ρ"), radius.value, "m", "\u{a0}×\u{a0}", true);
                }
                RotatingInertia::Weight(weight, radius) => {
                    push(named("W"), weight.value, "N", first, false);
                    push(Rich::italic("g"), g, "m/s^2", "\u{a0}/\u{a0}", false);
                    push(named("ρ"), radius.value, "m", "\u{a0}×\u{a0}", true);
                }
            }
            if rotating.ratio.value != 1.0 {
                let ratio = Rich::upright("(").then(&ratio(index, several, &speed)).up(")");
                push(ratio, rotating.ratio.value, "", "\u{a0}×\u{a0}", true);
            }
        }
        let set = |n: &[Rich]| {
            n.iter().zip(&signs).fold(Rich::default(), |sum, (own, (sign, square))| {
                sum.up(sign).then(own).up(if *square { "²" } else { "" })
            })
        };
        let reckon = |n: &[f64]| {
            let (mut sum, mut product) = (0.0, 0.0);
            for (own, (sign, square)) in n.iter().zip(&signs) {
                let own = if *square { own * own } else { *own };
                match *sign {
                    "\u{a0}×\u{a0}" => product *= own,
                    "\u{a0}/\u{a0}" => product /= own,
                    _ => {
                        sum += product;
                        product = own;
                    }
                }
            }
            sum + product
        };
        let inertia = self.number(CycleQuantity::Inertia, "kg*m^2")?;
        let value = inertia.2;
        let line = self.line(inertia, &factors, set, reckon)?;
        Some(self.as_asked(line, CycleQuantity::Inertia, value))
    }

    /// Both torques at the angle where they differ most, and that angle.
    fn torques_at(&self, of: CycleQuantity) -> Option<(f64, [f64; 2])> {
        let at = self.number(of, "")?.2;
        let which = if of == CycleQuantity::AtMost { CycleQuantity::Most } else { CycleQuantity::Least };
        let at_once = [0.0, -1e-9, 1e-9].map(|step| at + step * self.sheet.period);
        let both = at_once.map(|at| [0, 1].map(|side| height(&self.sheet.curves[side], at)));
        // Where one leaps, the side on which they differ by more.
        let sign = if which == CycleQuantity::Most { 1.0 } else { -1.0 };
        let mut torques =
            both.into_iter().max_by(|a, b| (sign * (a[0] - a[1])).total_cmp(&(sign * (b[0] - b[1]))))?;
        let cycle = self.cycle()?;
        let exact = |course: &Course| match course {
            Course::Curve(curve) => Waves::of(curve, cycle).map(|waves| waves.at(at)),
            Course::Of(_) => None,
        };
        let [torque, load] = match &cycle.sides {
            Sides::Torque(torque) => [exact(torque), None],
            Sides::Load(load) => [None, exact(load)],
            Sides::Both { torque, load } => [exact(torque), exact(load)],
            Sides::Areas { .. } => [None, None],
        };
        for (own, exact) in torques.iter_mut().zip([torque, load]) {
            *own = exact.unwrap_or(*own);
        }
        // A curve that was drawn point by point is read where the greatest difference was found.
        let inertia: f64 = self.turning()?.iter().map(|(_, _, value, _)| value).sum();
        if let Some((_, _, alpha, _)) = self.number(which, "rad/s^2") {
            let by = alpha * inertia - (torques[0] - torques[1]);
            let drawn = |side: usize| match &cycle.sides {
                Sides::Torque(Course::Of(_)) => side == 0,
                Sides::Load(Course::Of(_)) => side == 1,
                Sides::Both { torque, load } => {
                    matches!(if side == 0 { torque } else { load }, Course::Of(_))
                }
                _ => false,
            };
            if drawn(0) {
                torques[0] += by;
            } else if drawn(1) {
                torques[1] -= by;
            }
        }
        // What is left of a rounding is zero.
        let zero = 1e-9 * torques[0].abs().max(torques[1].abs());
        let torques = torques.map(|torque| if torque.abs() <= zero { 0.0 } else { torque });
        Some((at, torques))
    }

    /// Whatever turns: the inertia that is there, and the flywheel.
    fn turning(&self) -> Option<Vec<Factor>> {
        let all = [CycleQuantity::Inertia, CycleQuantity::Flywheel].map(|of| self.number(of, "kg*m^2"));
        let all: Vec<Factor> = all.into_iter().flatten().filter(|(_, _, value, _)| *value > 0.0).collect();
        (!all.is_empty()).then_some(all)
    }

    /// The two torques by their names: a mean is the mean.
    fn names(&self) -> [Rich; 2] {
        let mean = symbol(self.notation, CycleQuantity::Mean);
        let own = [Rich::italic("T"), Rich::italic("T").sub("l")];
        let [torque, load] = own;
        match self.sheet.constant {
            Some(0) => [mean, load],
            Some(_) => [torque, mean],
            None => [torque, load],
        }
    }

    /// Where the torques differ most: of waves the equation whose root it is.
    fn steepest(&self, of: CycleQuantity) -> Option<Rich> {
        let (name, key, at, _) = self.number(of, "")?;
        let degree = Unit { symbol: "°".to_owned(), si: std::f64::consts::PI / 180.0 };
        // The torques there are computed from it.
        if self.waves().is_some() {
            self.figures.borrow_mut().want_one(key?);
        }
        let angle = self.figures.borrow_mut().tell(key?, at, &degree);
        let told = name.up("\u{a0}= ").then(&angle).up("°");
        let [torque, load] = self.names();
        let difference = torque.up(" −\u{a0}").then(&load);
        let Some([_, net]) = self.waves() else {
            let most = if of == CycleQuantity::AtMost { "max" } else { "min" };
            return Some(Rich::upright("(").then(&difference).up(")").sub(most).up(":\u{a0}").then(&told));
        };
        let slope = net.slope().told(self.notation.scene.units.torque.si, rounded);
        let head = Rich::upright("d(").then(&difference).up(")\u{a0}/\u{a0}d").it("θ").up("\u{a0}= ");
        Some(head.then(&slope).up("\u{a0}= 0:\u{a0}").then(&told))
    }

    /// α = (T − T_l) / (I + I_f) where they differ most.
    fn fastest(&self, of: CycleQuantity, at: CycleQuantity) -> Option<Rich> {
        let (_, [torque, load]) = self.torques_at(at)?;
        let index = if of == CycleQuantity::Most { "max" } else { "min" };
        let result = self.number(of, "rad/s^2")?;
        let mean = self.number(CycleQuantity::Mean, TORQUE)?;
        let plain = |letter: Rich, value: f64| (letter, None, value, TORQUE);
        let sides = match self.sheet.constant {
            Some(0) => [mean, plain(Rich::italic("T").sub("l"), load)],
            Some(_) => [plain(Rich::italic("T").sub(index), torque), mean],
            None => [plain(Rich::italic("T"), torque), plain(Rich::italic("T").sub("l"), load)],
        };
        let turning = self.turning()?;
        let several = turning.len() > 1;
        if self.unit(TORQUE) != self.unit("N*m") {
            return self.fastest_in_si(result, sides, turning, index);
        }
        let factors: Vec<Factor> = sides.into_iter().chain(turning).collect();
        let set = |n: &[Rich]| {
            let over = Rich::upright("(").then(&n[0]).up("\u{a0}−\u{a0}").then(&n[1]).up(")\u{a0}/\u{a0}");
            match several {
                true => over.up("(").then(&n[2]).up("\u{a0}+\u{a0}").then(&n[3]).up(")"),
                false => over.then(&n[2]),
            }
        };
        self.line(result, &factors, set, |n| (n[0] - n[1]) / n[2..].iter().sum::<f64>())
    }

    /// The same of torques that are not in newton metres: first their difference, and what it is in these.
    fn fastest_in_si(
        &self,
        result: Factor,
        sides: [Factor; 2],
        turning: Vec<Factor>,
        index: &'static str,
    ) -> Option<Rich> {
        let own = Key::Given(if index == "max" { "most" } else { "least" });
        let value = sides[0].2 - sides[1].2;
        let symbol = Rich::upright("Δ").it("T").sub(index);
        let set = |n: &[Rich]| n[0].clone().up("\u{a0}−\u{a0}").then(&n[1]);
        let difference = (symbol.clone(), Some(own), value, TORQUE);
        let first = self.line(difference, &sides, set, |n| n[0] - n[1])?;
        let first = self.also(first, own, value, "N*m");
        let several = turning.len() > 1;
        let factors: Vec<Factor> = [(symbol, Some(own), value, "N*m")].into_iter().chain(turning).collect();
        let set = |n: &[Rich]| {
            let over = n[0].clone().up("\u{a0}/\u{a0}");
            match several {
                true => over.up("(").then(&n[1]).up("\u{a0}+\u{a0}").then(&n[2]).up(")"),
                false => over.then(&n[1]),
            }
        };
        let second = self.line(result, &factors, set, |n| n[0] / n[1..].iter().sum::<f64>())?;
        Some(first.up(self.notation.words.semicolon).then(&second))
    }

    /// Where the torques are equal, the areas between, and the levels, each from the numbers before.
    fn areas(&self) -> Option<Vec<Rich>> {
        let count = self.sheet.areas.len();
        if count == 0 || self.sheet.levels.len() != count {
            return None;
        }
        if count > TOLD {
            return Some(self.extremes_as_sums());
        }
        let mut lines = Vec::new();
        let by_angle = self.sheet.crossings.len() == count;
        if !by_angle {
            lines.extend(self.planimeter()?);
        } else if let Some((knots, _)) = self.corners(Of::Net) {
            lines.extend(self.by_trapezia(&knots));
        } else if let Some([_, net]) = self.waves() {
            lines.extend(self.where_they_cross());
            lines.extend(self.by_waves(&net));
        } else {
            lines.extend(self.where_they_cross());
            for (value, k) in self.sheet.areas.iter().zip(1_u32..) {
                lines.push(
                    self.measured(self.name(CycleQuantity::Area(k)), (key(CycleQuantity::Area(k)), *value)),
                );
            }
            let first = CycleQuantity::Level(1);
            let level = self.sheet.levels[0];
            lines.push(match level {
                0.0 => self.sum(self.name(first), &[], (key(first), 0.0)),
                _ => self.measured(self.name(first), (key(first), level)),
            });
        }
        lines.extend(self.levels(by_angle));
        self.alike(count);
        if let Some([highest, lowest]) = self.sheet.extremes {
            let mut figures = self.figures.borrow_mut();
            figures.alias(key(CycleQuantity::Highest), key(CycleQuantity::Level(counted(highest))));
            figures.alias(key(CycleQuantity::Lowest), key(CycleQuantity::Level(counted(lowest))));
        }
        Some(lines)
    }

    /// Of too many areas to be told one by one: what the highest and the lowest level are the sum of.
    fn extremes_as_sums(&self) -> Vec<Rich> {
        let by_angle = !self.sheet.crossings.is_empty();
        let joule = self.unit(ENERGY);
        let extremes = self.sheet.extremes.into_iter().flatten();
        let mut lines = Vec::new();
        for (index, whole) in extremes.zip([CycleQuantity::Highest, CycleQuantity::Lowest]) {
            let [of, level] = [CycleQuantity::Level(counted(index)), CycleQuantity::Level(1)];
            let value = self.sheet.levels[index];
            // From a crossing on the areas are counted that lie behind it.
            let areas = if by_angle { index } else { index + 1 };
            let mut terms: Vec<Rich> =
                (by_angle && index > 0).then(|| self.name(level)).into_iter().collect();
            terms.extend((areas > 0).then(|| self.name(CycleQuantity::Area(1))));
            terms.extend((areas > 2).then(|| Rich::upright("…")));
            terms.extend((areas > 1).then(|| self.name(CycleQuantity::Area(counted(areas - 1)))));
            let told = self.figures.borrow_mut().tell(key(of), value, &joule);
            self.figures.borrow_mut().alias(key(whole), key(of));
            let mut line = self.name(of).up("\u{a0}= ");
            if !terms.is_empty() {
                line = line.then(&Rich::join(&terms, &Rich::upright("\u{a0}+\u{a0}"))).up("\u{a0}= ");
            }
            lines.push(
                line.up(if value < 0.0 { "−" } else { "" }).then(&human::with_unit(&told, &joule.symbol)),
            );
        }
        lines
    }

    /// Areas stand under each other, and the level from which they are counted: what one of them needs all have.
    fn alike(&self, count: usize) {
        let areas = || (0..count).map(|index| key(CycleQuantity::Area(counted(index))));
        let keys = || areas().chain([key(CycleQuantity::Level(1))]);
        let mut figures = self.figures.borrow_mut();
        let most = keys().map(|key| figures.more(key)).max().unwrap_or(0);
        for key in keys().filter(|key| figures.more(*key) < most).collect::<Vec<_>>() {
            figures.want(key);
        }
    }

    fn name(&self, of: CycleQuantity) -> Rich {
        symbol(self.notation, of)
    }

    /// Each level is the one before and the area between, as both stand there: their sum has no more to be rounded. The first of
    /// areas alone is the first area.
    fn levels(&self, by_angle: bool) -> Vec<Rich> {
        let joule = self.unit(ENERGY);
        let mut lines = Vec::new();
        for (index, level) in self.sheet.levels.iter().enumerate() {
            let of = CycleQuantity::Level(counted(index));
            let Some(before) = index.checked_sub(1) else {
                if !by_angle {
                    let area = CycleQuantity::Area(1);
                    self.figures.borrow_mut().alias(key(of), key(area));
                    let told = self.figures.borrow_mut().tell(key(of), *level, &joule);
                    let line = self.name(of).up("\u{a0}= ").then(&self.name(area)).up("\u{a0}= ");
                    let line = line.up(if *level < 0.0 { "−" } else { "" });
                    lines.push(line.then(&human::with_unit(&told, &joule.symbol)));
                }
                continue;
            };
            let added = if by_angle { before } else { index };
            let [first, second] =
                [CycleQuantity::Level(counted(before)), CycleQuantity::Area(counted(added))];
            let [a, b] = [self.sheet.levels[before], self.sheet.areas[added]];
            let formula = self
                .name(of)
                .up("\u{a0}= ")
                .then(&self.name(first))
                .up("\u{a0}+\u{a0}")
                .then(&self.name(second));
            // The last level of a period is its beginning.
            if *level == 0.0 {
                let zero = self.figures.borrow_mut().tell(key(of), 0.0, &joule);
                lines.push(formula.up("\u{a0}= ").then(&human::with_unit(&zero, &joule.symbol)));
                continue;
            }
            let (before, between) = (key(first), key(second));
            let mut figures = self.figures.borrow_mut();
            let x = [(before, a), (between, b)].map(|(key, value)| figures.number(key, value, &joule));
            let sum = exact_sum([x[0].1.copysign(a), x[1].1.copysign(b)]);
            let own = level / joule.si;
            // It has no more decimals than the coarser of what is rounded in it.
            let rounded = |(text, number): &(Rich, f64), value: f64| {
                let exact = (value / joule.si).abs();
                ((number - exact).abs() > 1e-9 * exact).then(|| decimals(text)).flatten()
            };
            let known = [rounded(&x[0], a), rounded(&x[1], b)].into_iter().flatten().min();
            let (sum, text) = match known {
                Some(decimals) => to_decimals(sum, decimals),
                None => (sum, human::stated(sum.abs())),
            };
            // Where the sum is another number in three figures, or is needed in more, what is added has more.
            let third = |value: f64| format!("{value:.2e}");
            let coarse = third(sum) != third(own) && sum != 0.0 || sum.signum() != own.signum();
            for part in [before, between] {
                if coarse || figures.more(part) < figures.more(key(of)) {
                    figures.want(part);
                }
            }
            figures.note(key(of), &text, (sum.abs(), own.abs()), &joule);
            let sign = |value: f64, plain: &'static str, minus| if value < 0.0 { minus } else { plain };
            let line = formula.up("\u{a0}= ").up(sign(a, "", "−")).then(&x[0].0);
            let line = line.up(sign(b, "\u{a0}+\u{a0}", "\u{a0}−\u{a0}")).then(&x[1].0);
            let line = line.up("\u{a0}= ").up(sign(sum, "", "−"));
            lines.push(line.then(&human::with_unit(&text, &joule.symbol)));
        }
        lines
    }

    /// Crossings, areas and the first level of curves that are straight from corner to corner.
    fn by_trapezia(&self, knots: &[[f64; 2]]) -> Vec<Rich> {
        let both = self.sheet.constant.is_none();
        let mean = match self.sheet.answer(CycleQuantity::Mean) {
            Answer::Scalar { value, .. } if !both => value,
            _ => 0.0,
        };
        let period = self.sheet.period;
        let mut lines = Vec::new();
        for (index, crossing) in self.sheet.crossings.iter().enumerate() {
            lines.push(self.crossing(knots, (index, crossing.at), (!both).then_some(mean)));
        }
        // A load takes what it is over its mean.
        let gives = if self.sheet.constant == Some(0) { -1.0 } else { 1.0 };
        // By what has been turned, whichever way the input goes.
        let mut turned: Vec<[f64; 2]> =
            knots.iter().map(|[at, torque]| [*at, gives * (torque - mean)]).collect();
        if self.sheet.falling {
            turned.reverse();
            turned.iter_mut().for_each(|[at, _]| *at = period - *at);
        }
        let place = |at: f64| if self.sheet.falling && at > 0.0 { period - at } else { at };
        let crossings: Vec<f64> = self.sheet.crossings.iter().map(|crossing| place(crossing.at)).collect();
        // The excess from one angle to another, which may lie in the next period.
        let excess = |from: f64, to: f64| {
            const SAME: f64 = 1e-9;
            let shifted = |turn: f64| turned.iter().map(move |[at, net]| [at + turn, *net]);
            let all: Vec<[f64; 2]> = shifted(0.0).chain(shifted(period)).collect();
            let at = |angle: f64| all.iter().filter(move |knot| (knot[0] - angle).abs() <= SAME);
            let begins = at(from).next_back().map_or(0.0, |knot| knot[1]);
            let ends = at(to).next().map_or(0.0, |knot| knot[1]);
            let inside = all.iter().copied().filter(|[at, _]| from + SAME < *at && *at < to - SAME);
            [[from, begins]].into_iter().chain(inside).chain([[to, ends]]).collect::<Vec<[f64; 2]>>()
        };
        for (index, from) in crossings.iter().enumerate() {
            let to = crossings.get(index + 1).copied().unwrap_or(crossings[0] + period);
            let of = CycleQuantity::Area(counted(index));
            lines.push(self.sum(self.name(of), &excess(*from, to), (key(of), self.sheet.areas[index])));
        }
        let of = CycleQuantity::Level(1);
        let before = if crossings[0] > 1e-9 { excess(0.0, crossings[0]) } else { Vec::new() };
        lines.push(self.sum(self.name(of), &before, (key(of), self.sheet.levels[0])));
        lines
    }

    /// The angle of a crossing by proportion between two corners; of one at a corner that angle.
    fn crossing(&self, knots: &[[f64; 2]], (index, at): (usize, f64), mean: Option<f64>) -> Rich {
        let degree = Unit { symbol: "°".to_owned(), si: std::f64::consts::PI / 180.0 };
        let torque = self.unit(TORQUE);
        let of = CycleQuantity::Crossing(counted(index));
        let name = self.name(of).up("\u{a0}= ");
        let at_corner = |knot: &[f64; 2]| (knot[0] - at).abs() <= 1e-9;
        let piece = knots.windows(2).find(|pair| pair[0][0] < at && at < pair[1][0]);
        let Some([[from, low], [to, high]]) =
            piece.filter(|_| !knots.iter().any(at_corner)).map(|pair| [pair[0], pair[1]])
        else {
            let angle = self.figures.borrow_mut().tell(key(of), at, &degree);
            return name.then(&angle).up("°");
        };
        let level = mean.unwrap_or(0.0);
        let own = mean.map(|_| key(CycleQuantity::Mean));
        let factors = [
            (None, from, &degree),
            (own, level, &torque),
            (None, low, &torque),
            (None, high, &torque),
            (None, to - from, &degree),
        ];
        let signs = [from, level, low, high, to - from].map(f64::signum);
        let reckon = |x: &[f64]| {
            let x: [f64; 5] = std::array::from_fn(|i| x[i] * signs[i]);
            x[0] + x[4] * (x[1] - x[2]) / (x[3] - x[2])
        };
        let told = (Some(key(of)), at, &degree);
        let (x, text, _) = self.figures.borrow_mut().line_from(&factors, told, reckon);
        let signed = |value: f64, text: &Rich| match value < 0.0 {
            true => Rich::upright("−").then(text),
            false => text.clone(),
        };
        let minus = |first: &Rich, second: &Rich, negative: bool| {
            let sign = if negative { "\u{a0}+\u{a0}" } else { "\u{a0}−\u{a0}" };
            Rich::upright("(").then(first).up(sign).then(second).up(")")
        };
        let top = match mean {
            Some(_) => minus(&signed(level, &x[1]), &x[2], low < 0.0),
            // Against its load a difference has to come to zero.
            None if low > 0.0 => Rich::upright("(−").then(&x[2]).up(")"),
            None => x[2].clone(),
        };
        let line = name.then(&x[0]).up("°\u{a0}+\u{a0}").then(&x[4]).up("°\u{a0}×\u{a0}").then(&top);
        let line = line.up("\u{a0}/\u{a0}").then(&minus(&signed(high, &x[3]), &x[2], low < 0.0));
        line.up("\u{a0}= ").then(&text).up("°")
    }

    /// Areas and the first level of waves: an integral at two angles.
    fn by_waves(&self, net: &Waves) -> Vec<Rich> {
        let integral = net.integral();
        let of = |at: Rich| Rich::upright("Φ(").then(&at).up(")");
        let [torque, load] = self.names();
        let head = of(Rich::italic("θ")).up("\u{a0}= ∫\u{a0}(").then(&torque).up(" −\u{a0}").then(&load);
        let head = head.up(")\u{a0}d").it("θ").up("\u{a0}= ");
        let joule = self.unit(ENERGY);
        let told = integral.told(joule.si, rounded);
        let mut lines = vec![head.then(&human::with_unit(&told, &joule.symbol))];
        // From where the motion comes to where it goes.
        let mut between = |of_line: CycleQuantity, [from, to]: [(Rich, f64); 2], value: f64| {
            let ends = [&to, &from].map(|(_, at)| integral.at(*at));
            let zero = 1e-9 * integral.size();
            let ends = ends.map(|end| if end.abs() <= zero { 0.0 } else { end });
            let gives = if self.sheet.falling { -1.0 } else { 1.0 };
            let factors = ends.map(|end| (None, end, &joule));
            let reckon = |x: &[f64]| (x[0].copysign(ends[0]) - x[1].copysign(ends[1])).abs();
            let (x, text, _) = self.figures.borrow_mut().line_from(
                &factors,
                (Some(key(of_line)), value.abs(), &joule),
                reckon,
            );
            let sign = |end: f64, text: &Rich| match end < 0.0 {
                true => Rich::upright("(−").then(text).up(")"),
                false => text.clone(),
            };
            let difference = |a: &Rich, b: &Rich| match gives > 0.0 {
                true => a.clone().up(" −\u{a0}").then(b),
                false => b.clone().up(" −\u{a0}").then(a),
            };
            let symbols = difference(&of(to.0), &of(from.0));
            let numbers = difference(&sign(ends[0], &x[0]), &sign(ends[1], &x[1]));
            let line = self.name(of_line).up("\u{a0}= ").then(&symbols).up("\u{a0}= ").then(&numbers);
            let line = line.up("\u{a0}= ").up(if value < 0.0 { "−" } else { "" });
            lines.push(line.then(&human::with_unit(&text, &joule.symbol)));
        };
        let crossing = |index: usize| {
            let index = index % self.sheet.crossings.len();
            (self.name(CycleQuantity::Crossing(counted(index))), self.sheet.crossings[index].at)
        };
        for (index, area) in self.sheet.areas.iter().enumerate() {
            between(CycleQuantity::Area(counted(index)), [crossing(index), crossing(index + 1)], *area);
        }
        let first = CycleQuantity::Level(1);
        if self.sheet.levels[0] == 0.0 {
            lines.push(self.sum(self.name(first), &[], (key(first), 0.0)));
        } else {
            between(first, [(Rich::upright("0"), 0.0), crossing(0)], self.sheet.levels[0]);
        }
        lines
    }

    /// ω = 2πn/60, where the scene states it otherwise.
    fn speed_in_radians(&self) -> Option<Rich> {
        let omega = self.notation.mechanism().forces.cycle.as_ref()?.omega.value;
        let stated = self.notation.scene.input_units.first()?.rate.as_ref()?;
        let name = Rich::italic("ω");
        in_radians(name, (omega, stated), Key::Given("ω"), self.notation, self.figures, Order::Velocity)
    }

    /// A line with its formula, its numbers and its result; `None` where a sign would have to be told.
    fn line(
        &self,
        (name, key, value, unit): Factor,
        factors: &[Factor],
        set: impl Fn(&[Rich]) -> Rich,
        reckon: impl Fn(&[f64]) -> f64,
    ) -> Option<Rich> {
        let equals = "\u{a0}= ";
        let symbols: Vec<Rich> = factors.iter().map(|(symbol, ..)| symbol.clone()).collect();
        let formula = name.up(equals).then(&set(&symbols));
        let units: Vec<Unit> = factors.iter().map(|(.., unit)| self.unit(unit)).collect();
        let told: Vec<(Option<Key>, f64, &Unit)> =
            factors.iter().zip(&units).map(|((_, key, value, _), unit)| (*key, *value, unit)).collect();
        let result = self.unit(unit);
        let signs: Vec<f64> = factors.iter().map(|(_, _, value, _)| value.signum()).collect();
        let signed = |numbers: &[f64]| {
            let numbers: Vec<f64> = numbers.iter().zip(&signs).map(|(number, sign)| number * sign).collect();
            reckon(&numbers)
        };
        let (numbers, text, _) = self.figures.borrow_mut().line_from(&told, (key, value, &result), signed);
        let numbers: Vec<Rich> = numbers
            .into_iter()
            .zip(&signs)
            .map(|(number, sign)| match *sign < 0.0 {
                true => Rich::upright("(−").then(&number).up(")"),
                false => number,
            })
            .collect();
        let line = formula.up(equals).then(&set(&numbers)).up(equals);
        Some(line.then(&human::with_unit(&text, &result.symbol)))
    }
}

/// The speed of the input, and under what key it stands.
fn speed(notation: &Notation<'_>) -> (Rich, Key) {
    match notation.mechanism().inputs.first() {
        Some(Input::Angle { link, .. }) => {
            let quantity = Quantity::Omega(*link);
            (notation.symbol(quantity, false), Key::Of(quantity))
        }
        _ => (Rich::italic("ω"), Key::Given("ω")),
    }
}

/// The speed of what turns with the input over that of the input: ω′/ω₂, of several the first ω′₁/ω₂.
fn ratio(index: usize, several: bool, input: &Rich) -> Rich {
    let number = if several { (index + 1).to_string() } else { String::new() };
    Rich::italic("ω").up("′").sub(&number).up("/").then(input)
}

/// The moment of inertia of what turns with the input: where it alone turns, but at another speed, I′, for I is that of all.
pub(super) fn own_inertia(cycle: &Cycle, sub: &str, of: &Rotating) -> Rich {
    let other = cycle.rotating.len() == 1 && of.ratio.value != 1.0;
    Rich::italic("I").up(if other { "′" } else { "" }).sub(sub)
}

/// The same as it is given.
pub(super) fn given_ratio(index: usize, several: bool, notation: &Notation<'_>) -> Rich {
    ratio(index, several, &speed(notation).0)
}

/// Of what a corner is: the driving torque, or what it is over what it works against.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Torque,
    Net,
}

fn key(of: CycleQuantity) -> Key {
    Key::Of(Quantity::Cycle(of))
}

/// The decimals of a printed number; none of one with a power of ten.
fn decimals(text: &Rich) -> Option<usize> {
    let plain = text.plain();
    let digits = plain.chars().all(|c| c.is_ascii_digit() || ['.', '\u{2009}'].contains(&c));
    digits.then(|| plain.split_once('.').map_or(0, |(_, after)| after.len()))
}

/// A sum to so many decimals, and how its size is printed with all of them.
fn to_decimals(sum: f64, places: usize) -> (f64, Rich) {
    let sum: f64 = format!("{sum:.places$}").parse().unwrap_or(sum);
    let text = human::stated(sum.abs());
    let missing = decimals(&text).map_or(0, |own| places.saturating_sub(own));
    let point = if missing == places && missing > 0 { "." } else { "" };
    (sum, text.up(point).up(&"0".repeat(missing)))
}

/// The sum of two printed numbers, without the last bits of a double.
fn exact_sum(numbers: [f64; 2]) -> f64 {
    /// No printed number has more decimals.
    const MOST: usize = 9;
    let sum: f64 = numbers.iter().sum();
    let to = |value: f64, decimals: usize| format!("{value:.decimals$}").parse().unwrap_or(value);
    let written =
        |decimals: &usize| numbers.iter().all(|own| (to(*own, *decimals) - own).abs() <= 1e-12 * own.abs());
    (0..=MOST).find(written).map_or(sum, |decimals| to(sum, decimals))
}

fn counted(index: usize) -> u32 {
    u32::try_from(index + 1).unwrap_or(u32::MAX)
}

/// The difference of two curves that have their points at the same angles.
fn net(torque: &[[f64; 2]], load: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let mut net = Vec::new();
    let (mut i, mut k) = (0, 0);
    while let (Some(own), Some(other)) = (torque.get(i), load.get(k)) {
        net.push([own[0], own[1] - other[1]]);
        // A curve that leaps has a second point where the other has one.
        let again = |curve: &[[f64; 2]], at: usize| curve.get(at + 1).is_some_and(|next| next[0] == own[0]);
        match (again(torque, i), again(load, k)) {
            (true, false) => i += 1,
            (false, true) => k += 1,
            _ => {
                i += 1;
                k += 1;
            }
        }
    }
    net
}

/// A curve without the points that lie on a straight line between their neighbours.
fn only_corners(curve: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let size = curve.iter().fold(0.0, |most: f64, [_, torque]| most.max(torque.abs()));
    let mut corners: Vec<[f64; 2]> = Vec::new();
    for point in curve {
        while let [.., a, b] = corners[..] {
            let straight = a[0] < b[0] && b[0] < point[0] && {
                let between = a[1] + (point[1] - a[1]) * (b[0] - a[0]) / (point[0] - a[0]);
                (between - b[1]).abs() <= 1e-9 * size
            };
            if !straight {
                break;
            }
            corners.pop();
        }
        corners.push(point);
    }
    corners
}
