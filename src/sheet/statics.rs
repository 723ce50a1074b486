//! The forces as they are told: weights and inertia, and of every body its balance, the moments that give a size, the
//! polygon that gives the rest.

use std::cell::RefCell;

use super::forces::{ForcePanel, laid_off_in_parts, per_mm, pole};
use super::given::{handy, largest};
use super::human;
use super::notation::Notation;
use super::printed::{Figures, Key, Print, either};
use super::rich::Rich;
use super::steps::Item;
use super::table::{Align, Flow, Table};
use crate::graphical::construction::{
    About, Acting, Arm, Construction, ForceSheet, FreeBody, FrictionAxis, GroupTrial, Knowledge, Label,
    LoadSize, MassForces, MomentBalance, MomentTerm, Parts, SpringTwist, Touch, Trials, Turning,
};
use crate::graphical::is_a_point;
use crate::mechanism::curve::Curve;
use crate::mechanism::force::{
    Action, Area, Force, Heaviness, Inertia, LoadKind, Party, Pressure, Share, Size, Sought,
};
use crate::mechanism::force::{SpringKind, SpringLaw};
use crate::mechanism::friction::{FrictionCircle, Roughness, RubbedBy, RubbingPair};
use crate::mechanism::quantity::{Answer, Asked, DiagramKind, Dimension, Order, Quantity, Unit};
use crate::mechanism::structure::{Closing, TrialDriver};
use crate::mechanism::{LinkId, PointId, Roll};

/// A side of a polygon that is shorter is not read, mm.
const TOO_SHORT: f64 = 1.0;
pub(super) const TIMES: &str = "\u{a0}×\u{a0}";
pub(super) const DOT: &str = "\u{a0}·\u{a0}";
pub(super) const OVER: &str = "\u{a0}/\u{a0}";
pub(super) const EQUALS: &str = "\u{a0}= ";

/// Everything that is told of forces, each with what is drawn beside it; with the figures in which its numbers are printed
/// on the sheet.
#[must_use]
pub fn told(
    sheet: &ForceSheet,
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Vec<(ForcePanel, Vec<Item>)> {
    let teller = Teller { sheet, construction, n: notation, figures, share: sheet.share, several: false };
    let mut all = vec![(ForcePanel::Loads, teller.given())];
    for index in 0..sheet.bodies.len() {
        for rub in super::friction::before(index, sheet) {
            all.push((ForcePanel::Friction(rub), teller.friction(rub)));
        }
        all.extend(teller.body(index));
    }
    for pair in teller.asked_of_pins() {
        let [of, is] = pair.map(|action| teller.whole(Force::Vector(action)));
        figures.borrow_mut().alias(of, is);
    }
    all.push((ForcePanel::Whole, teller.whole_told()));
    all.push((ForcePanel::Shaking, teller.shaking()));
    all.push((ForcePanel::Frame, teller.on_frame()));
    all.push((ForcePanel::Loads, teller.stiffnesses()));
    all.push((ForcePanel::Arms, teller.asked_arms()));
    all.push((ForcePanel::Whole, teller.shares()));
    // A head alone says nothing.
    all.retain(|(panel, items)| {
        let figure = matches!(panel, ForcePanel::Body(_) | ForcePanel::Together(_) | ForcePanel::Polygon(_));
        figure || items.iter().any(|item| !matches!(item, Item::Head(_)))
    });
    all
}

/// The name of an arm: that of the length where it is one, else x with its number on the sheet.
#[must_use]
pub fn arm_name(sheet: &ForceSheet, arm: &Arm, notation: &Notation<'_>) -> Rich {
    if let Some([from, to]) = arm.between {
        return notation.length(from, to);
    }
    if let Some(own) = asked(sheet, arm) {
        return notation.symbol(Quantity::Force(own, Share::Total), false);
    }
    match numbered(sheet, arm) {
        Some(number) => Rich::italic("x").sub(&format!("{number}")),
        None => Rich::italic("e"),
    }
}

/// The arm that is asked, where no balance has it.
fn asked(sheet: &ForceSheet, arm: &Arm) -> Option<Force> {
    let own = sheet.arms.iter().find(|own| own.told == 0 && own.found.arm == Some(*arm))?;
    match own.found.of {
        Turning::Torque(Force::Arm(action, about) | Force::Moment(action, about)) => {
            Some(Force::Arm(action, about))
        }
        _ => None,
    }
}

/// The number of an arm on the sheet, from 1 on; an arm that only the shaking force has has none.
fn numbered(sheet: &ForceSheet, arm: &Arm) -> Option<usize> {
    let last = sheet.shaking.as_ref().and_then(|shaking| shaking.found.arm);
    let of_others = || {
        let all = sheet.moments.iter().chain(&sheet.frame_line);
        all.flat_map(|moments| moments.terms.iter().chain([&moments.found]))
    };
    if last.is_some_and(|last| last == *arm) && !of_others().any(|term| term.arm == Some(*arm)) {
        return None;
    }
    let all = sheet.moments.iter().chain(&sheet.frame_line).chain(&sheet.shaking);
    let arms =
        all.flat_map(|moments| moments.terms.iter().chain([&moments.found])).filter_map(|term| term.arm);
    // Forces on one line have one arm.
    let mut own: Vec<Arm> = Vec::new();
    for other in arms.filter(|other| other.between.is_none()) {
        if !own.contains(&other) {
            own.push(other);
        }
    }
    own.iter().position(|other| other == arm).map(|place| place + 1)
}

/// The symbol of what has a moment.
#[must_use]
pub fn symbol(of: Turning, notation: &Notation<'_>) -> Rich {
    let force = |force: Force| notation.symbol(Quantity::Force(force, Share::Total), false);
    let part = |action: Action, mark: &str| super::force_names::part(notation, action, mark);
    match of {
        Turning::Force(action) => force(Force::Vector(action)),
        Turning::Along(action) => part(action, notation.profile.normal),
        Turning::Across(action) => part(action, notation.profile.tangential),
        Turning::Torque(torque) => force(torque),
    }
}

#[derive(Clone, Copy)]
pub(super) struct Teller<'a> {
    pub(super) sheet: &'a ForceSheet,
    pub(super) construction: &'a Construction,
    pub(super) n: &'a Notation<'a>,
    pub(super) figures: &'a RefCell<Figures>,
    /// Of which part of the forces is told.
    pub(super) share: Share,
    /// Whether it is told of several, so that names have a mark.
    pub(super) several: bool,
}

/// A number in a computed line: its value, the unit of the scene, and the SI unit; and what it is of, where other lines
/// tell it too.
#[derive(Clone, Copy)]
pub(super) struct Factor<'a> {
    si: f64,
    unit: &'a Unit,
    name: &'static str,
    key: Option<Key>,
}

impl<'a> Factor<'a> {
    pub(super) const fn new(si: f64, unit: &'a Unit, name: &'static str) -> Self {
        Self { si, unit, name, key: None }
    }

    pub(super) const fn of(self, key: Key) -> Self {
        Self { key: Some(key), ..self }
    }

    /// The SI unit.
    fn base(&self) -> Unit {
        if (self.unit.si - 1.0).abs() < 1e-12 {
            return self.unit.clone();
        }
        Unit { symbol: self.name.to_owned(), si: 1.0 }
    }
}

impl Teller<'_> {
    /// A force as a number on the sheet.
    pub(super) fn whole(&self, force: Force) -> Key {
        let force = match force {
            // A weight stands as M g gave it.
            Force::Vector(Action::Weight(link)) if self.n.mechanism().shared_by(link) == 1.0 => {
                return Key::OfLink("W", link);
            }
            Force::Vector(action) => Force::Vector(either(action)),
            Force::Moment(action, about) => Force::Moment(either(action), about),
            other => other,
        };
        Key::Of(Quantity::Force(force, self.share))
    }

    /// The part of a force across the line of a link, or along a guide.
    pub(super) fn part_key(&self, action: Action) -> Key {
        match self.share == self.sheet.share {
            true => Key::Part(either(action), true),
            false => Key::Of(Quantity::Force(Force::Vector(either(action)), self.share)),
        }
    }

    /// What has a moment, as a number on the sheet.
    fn key_of(&self, of: Turning) -> Key {
        match of {
            Turning::Force(action) => self.whole(Force::Vector(action)),
            Turning::Along(action) => Key::Part(either(action), false),
            Turning::Across(action) => self.part_key(action),
            Turning::Torque(torque) => self.whole(torque),
        }
    }

    /// The symbol of the part of a force across the line of a link, or along a guide.
    pub(super) fn part(&self, action: Action) -> Rich {
        let sense = match self.mark() {
            Share::Rising => "′",
            Share::Falling => "″",
            Share::Total | Share::Static | Share::Inertia => "",
        };
        super::force_names::part(self.n, action, &format!("{}{sense}", self.n.profile.tangential))
    }

    /// The symbol of what has a moment, with the mark of the sense that is told.
    fn name_of(&self, of: Turning) -> Rich {
        match of {
            Turning::Force(action) => self.symbol(action),
            Turning::Across(action) => self.part(action),
            Turning::Along(_) | Turning::Torque(_) => symbol(of, self.n),
        }
    }

    /// A reading of a length on the skeleton with what it is by the scale: that of what was read.
    pub(super) fn measured(&self, key: Key, metres: f64, mm: f64) -> (Rich, Rich) {
        let unit = &self.n.scene.units.length;
        let mut figures = self.figures.borrow_mut();
        let factor = metres / unit.si / mm;
        if !figures.has(key) {
            let (_, amount, written) = human::measured_at(mm, factor, metres / unit.si, figures.more(key));
            figures.note(key, &amount, (written, metres / unit.si), unit);
        }
        let (reading, ..) = human::measured_at(mm, factor, metres / unit.si, figures.more(key));
        let told = figures.tell(key, metres, unit);
        (reading, human::with_unit(&told, &unit.symbol))
    }
    fn head(&self, text: Rich) -> Item {
        Item::Head(text.bolder())
    }

    pub(super) fn symbol(&self, action: Action) -> Rich {
        super::force_names::acting_in(self.n, action, self.mark())
    }

    fn force(&self, newtons: f64) -> Rich {
        human::quantity(newtons, &self.n.scene.units.force)
    }

    fn torque(&self, value: f64) -> Rich {
        self.n.rotation(value, &self.n.scene.units.torque)
    }

    fn length(&self, metres: f64) -> Rich {
        human::quantity(metres, &self.n.scene.units.length)
    }

    /// A computed line: in the scene's units where they go together, else in SI, and the result in the scene's unit
    /// after it. The operators stand between the factors.
    pub(super) fn line(
        &self,
        of: Rich,
        formula: Rich,
        factors: &[Factor<'_>],
        set: impl Fn(&[Rich]) -> Rich,
        reckon: impl Fn(&[f64]) -> f64,
        result: Factor<'_>,
    ) -> Rich {
        let units: Vec<f64> = factors.iter().map(|factor| factor.unit.si).collect();
        let together = (reckon(&units) / result.unit.si - 1.0).abs() < 1e-9;
        self.line_in(together, of, formula, factors, set, reckon, (result, result.unit))
    }

    /// The same where it is known whether the units of the scene go together, and in which unit the result is told last.
    #[expect(clippy::too_many_arguments, reason = "a line has a name, a formula, numbers and a result")]
    pub(super) fn line_in(
        &self,
        together: bool,
        of: Rich,
        formula: Rich,
        factors: &[Factor<'_>],
        set: impl Fn(&[Rich]) -> Rich,
        reckon: impl Fn(&[f64]) -> f64,
        (result, told): (Factor<'_>, &Unit),
    ) -> Rich {
        let line = of.up(EQUALS).then(&formula).up(EQUALS);
        let bases: Vec<Unit> = factors.iter().map(Factor::base).collect();
        let in_units = factors.iter().zip(&bases);
        let values: Vec<(Option<Key>, f64, &Unit)> = in_units
            .map(|(factor, base)| (factor.key, factor.si, if together { factor.unit } else { base }))
            .collect();
        let base = result.base();
        let unit = if together { result.unit } else { &base };
        let (mut written, text, number) =
            self.figures.borrow_mut().line_of(&values, (result.key, result.si, unit), &reckon);
        if !together {
            for (text, factor) in written.iter_mut().zip(factors) {
                *text = human::with_unit(text, factor.name);
            }
        }
        let line = line.then(&set(&written)).up(EQUALS).then(&human::with_unit(&text, &unit.symbol));
        if *unit == *told {
            return line;
        }
        let more = result.key.map_or(0, |key| self.figures.borrow().more(key));
        let exact = result.si / told.si;
        let (text, own) = human::in_common(number * unit.si / told.si, exact, more);
        if let Some(key) = result.key {
            let mut figures = self.figures.borrow_mut();
            // Where rounding twice would be seen the first number has a figure more.
            if text != human::limited(exact, more).0 {
                figures.want(key);
            }
            // What follows uses the number that stands here.
            let bare = if own < 0.0 { human::limited(own.abs(), more).0 } else { text.clone() };
            figures.note_also(key, &bare, (own.abs(), exact.abs()), told);
        }
        line.up(EQUALS).then(&human::with_unit(&text, &told.symbol))
    }

    fn acceleration(&self) -> Unit {
        self.n.unit(Dimension::Acceleration)
    }

    /// Loads by pressure and springs, weights, and the inertia of every mass.
    fn given(&self) -> Vec<Item> {
        let words = self.n.words;
        let mut items = vec![self.head(Rich::upright(words.step_inertia))];
        let mut lines: Vec<Rich> = self.loads();
        for mass in &self.sheet.masses {
            lines.extend(self.mass(mass));
        }
        if let Some(governor) = &self.sheet.governor {
            lines.extend(self.governor_given(governor));
        }
        if self.sheet.governor.is_none() {
            let sense = match self.sheet.share {
                Share::Rising => Some(words.governor_up),
                Share::Falling => Some(words.governor_down),
                Share::Total | Share::Static | Share::Inertia => None,
            };
            lines.extend(
                sense.map(|sense| Rich::fill(words.told_of_sense, &[("sense", Rich::upright(sense))])),
            );
        }
        // What is sought elsewhere than at the input is known from here on.
        lines.extend(self.sheet.trial.iter().map(|trial| self.trial(trial)));
        lines.extend(self.sheet.trials.iter().flat_map(|trials| self.trials(trials)));
        items.extend(lines.into_iter().map(Item::Sentence));
        items
    }

    /// What loads and springs come to that are not given as forces.
    fn loads(&self) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let forces = &self.n.mechanism().forces;
        let mut lines = Vec::new();
        for size in &self.sheet.sizes {
            lines.extend(self.size(size));
        }
        for (index, load) in forces.loads.iter().enumerate() {
            let LoadKind::Force { size: Size::Pressure { pressure, area }, .. } = load.kind else { continue };
            let pressure = match pressure {
                Pressure::Given(pressure) => pressure.value,
                Pressure::Curve(_) => match self.sheet.sizes.iter().find(|size| size.load == index) {
                    Some(size) => size.height,
                    None => continue,
                },
            };
            let name = super::force_names::load(self.n, index);
            let square =
                Unit { symbol: format!("{}^2", units.length.symbol), si: units.length.si * units.length.si };
            let size = match area {
                Area::Given(given) => given.value,
                Area::Bore { bore, rod } => {
                    let rod = rod.map(|rod| rod.value);
                    let of = |d: f64| Factor::new(d, &units.length, "m");
                    let less = rod.map_or(0.0, |rod| rod * rod);
                    let value = std::f64::consts::PI / 4.0 * (bore.value * bore.value - less);
                    let result = Factor::new(value, &square, "m²");
                    let formula = match rod {
                        None => Rich::upright("π\u{2009}").it("D").up("²").up(OVER).up("4"),
                        Some(_) => {
                            Rich::upright("π\u{2009}(").it("D").up("² − ").it("d").up("²)").up(OVER).up("4")
                        }
                    };
                    let factors: Vec<Factor<'_>> =
                        [Some(bore.value), rod].into_iter().flatten().map(of).collect();
                    let set = |numbers: &[Rich]| match numbers {
                        [d] => Rich::upright("π").up(TIMES).then(d).up("²").up(OVER).up("4"),
                        [d, rod] => {
                            let inside = d.clone().up("² − ").then(rod).up("²");
                            Rich::upright("π").up(TIMES).up("(").then(&inside).up(")").up(OVER).up("4")
                        }
                        _ => Rich::default(),
                    };
                    let reckon = |n: &[f64]| {
                        let less = n.get(1).map_or(0.0, |rod| rod * rod);
                        std::f64::consts::PI / 4.0 * (n[0] * n[0] - less)
                    };
                    lines.push(self.line_of_area(
                        formula,
                        &factors,
                        set,
                        reckon,
                        result.of(Key::Area(index)),
                    ));
                    value
                }
            };
            let area = Factor::new(size, &square, "m²").of(Key::Area(index));
            let factors = [Factor::new(pressure, &units.pressure, "Pa"), area];
            let load = self.whole(Force::Vector(Action::Load(index)));
            let result = Factor::new(pressure * size, &units.force, "N").of(load);
            let formula = Rich::italic("p").up(DOT).it("A");
            lines.push(self.line(name, formula, &factors, product, |n| n.iter().product(), result));
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            let SpringKind::Pull([(_, from), (_, to)]) = spring.kind else { continue };
            let SpringLaw::Stiffness { stiffness: Size::Given(stiffness), free } = spring.law else {
                continue;
            };
            let place =
                |p: crate::mechanism::PointId| self.construction.space.places.get(p.0).copied().flatten();
            let (Some(a), Some(b)) = (place(from), place(to)) else { continue };
            let mm = libm::hypot(a[0] - b[0], a[1] - b[1]);
            let length = mm * self.construction.space.metres_per_mm;
            let name = self.n.symbol(Quantity::Force(Force::Pull(index), Share::Total), false);
            let of_length = Key::length([from, to]);
            let (reading, read) = self.measured(of_length, length, mm);
            let metres_per_mm = self.construction.space.metres_per_mm;
            let told = [reading, read];
            lines.push(super::steps::measured_length(self.n.length(from, to), told, metres_per_mm, self.n));
            let factors = [
                Factor::new(stiffness.value, &units.stiffness, "N/m"),
                Factor::new(length, &units.length, "m").of(of_length),
                Factor::new(free.value, &units.length, "m"),
            ];
            // A spring that is shorter than without load pushes; its pull is told where that is asked.
            let shorter = length < free.value;
            let pushes = shorter && !self.asks(Force::Pull(index));
            let pull = stiffness.value * (length - free.value);
            let end =
                Key::Of(Quantity::Force(Force::Vector(either(Action::Spring { index, end: 0 })), self.share));
            let result = Factor::new(if pushes { -pull } else { pull }, &units.force, "N").of(end);
            let (now, without) = (self.n.length(from, to), Rich::italic("l").sub(&spring.name));
            let minus = |now: &Rich, without: &Rich| match pushes {
                true => without.clone().up(" − ").then(now),
                false => now.clone().up(" − ").then(without),
            };
            let formula =
                Rich::italic("K").sub(&spring.name).up("\u{2009}(").then(&minus(&now, &without)).up(")");
            let set = |n: &[Rich]| n[0].clone().up(TIMES).up("(").then(&minus(&n[1], &n[2])).up(")");
            let reckon = |n: &[f64]| if pushes { n[0] * (n[2] - n[1]) } else { n[0] * (n[1] - n[2]) };
            let line = self.line(name, formula, &factors, set, reckon, result);
            self.figures.borrow_mut().alias(self.whole(Force::Pull(index)), end);
            lines.push(match shorter {
                true => line.aside(self.n.words.comma, &Rich::upright(self.n.words.spring_pushes)),
                false => line,
            });
        }
        for twist in &self.sheet.twists {
            lines.extend(self.twist(twist));
        }
        lines
    }

    /// What a load comes to at the angle of the input: straight between the knots of its table on either side.
    fn size(&self, of: &LoadSize) -> Option<Rich> {
        let units = &self.n.scene.units;
        let forces = &self.n.mechanism().forces;
        let load = &forces.loads[of.load];
        let curve = &forces.curves[load.curve()?];
        let (name, unit, si) = match load.kind {
            LoadKind::Force { size: Size::Pressure { .. }, .. } => {
                (Rich::italic("p"), handy(&units.pressure, largest(curve)), "Pa")
            }
            LoadKind::Torque { .. } => {
                (super::force_names::load(self.n, of.load), units.torque.clone(), "N\u{a0}m")
            }
            _ => (super::force_names::load(self.n, of.load), units.force.clone(), "N"),
        };
        let unit = &unit;
        let name = name.up("(").it("θ").up(EQUALS).then(&human::degrees(of.angle)).up(")");
        let told = name.clone().up(EQUALS).then(&human::quantity(of.height, unit));
        let Curve::Table { knots, period } = curve else { return Some(told) };
        let knots: Vec<[f64; 2]> = knots.iter().map(|knot| knot.map(|given| given.value)).collect();
        let turns = libm::floor((of.angle - knots[0][0]) / period.value);
        let here = of.angle - turns * period.value;
        let next = knots.partition_point(|knot| knot[0] <= here);
        let from = *knots.get(next.checked_sub(1)?)?;
        let to = match knots.get(next) {
            Some(to) => *to,
            None => [knots[0][0] + period.value, knots[0][1]],
        };
        if here - from[0] < 1e-9 || to[0] - here < 1e-9 {
            return Some(told);
        }
        let degree = Unit { symbol: "°".to_owned(), si: std::f64::consts::PI / 180.0 };
        let angle = |value: f64| Factor::new(value, &degree, "°");
        let size = |value: f64| Factor::new(value, unit, si);
        let factors = [size(from[1]), size(to[1]), angle(here), angle(from[0]), angle(to[0])];
        let set = |n: &[Rich]| {
            let rise = Rich::upright("(").then(&n[1]).up(" − ").then(&n[0]).up(")");
            let part = Rich::upright("(").then(&n[2]).up(" − ").then(&n[3]).up(")");
            let whole = Rich::upright("(").then(&n[4]).up(" − ").then(&n[3]).up(")");
            n[0].clone().up(" + ").then(&rise).up(TIMES).then(&part).up(OVER).then(&whole)
        };
        let reckon = |n: &[f64]| n[0] + (n[1] - n[0]) * (n[2] - n[3]) / (n[4] - n[3]);
        let result = size(of.height);
        let values: Vec<(Option<Key>, f64, &Unit)> =
            factors.iter().map(|factor| (factor.key, factor.si, factor.unit)).collect();
        let (written, text, _) =
            self.figures.borrow_mut().line_of(&values, (result.key, result.si, unit), reckon);
        Some(name.up(EQUALS).then(&set(&written)).up(EQUALS).then(&human::with_unit(&text, &unit.symbol)))
    }

    /// The torque of a torsion spring on its second link, by how much further that is turned than without load.
    fn twist(&self, of: &SpringTwist) -> Option<Rich> {
        let spring = &self.n.mechanism().forces.springs[of.spring];
        let SpringLaw::Stiffness { stiffness: Size::Given(stiffness), free } = spring.law else {
            return None;
        };
        let name = self.n.symbol(Quantity::Force(Force::Twist(of.spring), Share::Total), false);
        let (per_radian, radian) =
            (Unit { symbol: "N*m/rad".to_owned(), si: 1.0 }, Unit { symbol: "rad".to_owned(), si: 1.0 });
        let now = free.value + of.further;
        let factors = [
            Factor::new(stiffness.value, &per_radian, "N\u{a0}m/rad"),
            Factor::new(free.value, &radian, "rad"),
            Factor::new(now, &radian, "rad"),
        ];
        let torque = &self.n.scene.units.torque;
        // Its size and its sense; with a sign where that is asked.
        let turned_round = of.further > 0.0 && !self.asks(Force::Twist(of.spring));
        let exerted = -stiffness.value * of.further;
        let result = Factor::new(if turned_round { -exerted } else { exerted }, torque, "N\u{a0}m")
            .of(self.whole(Force::Twist(of.spring)));
        let names = [Rich::italic("φ").sub(&spring.name), Rich::italic("φ")];
        let order = |pair: [Rich; 2]| {
            let [without, with] = pair;
            if turned_round { [with, without] } else { [without, with] }
        };
        let [first, second] = order(names);
        let formula =
            Rich::italic("K").sub(&spring.name).up("\u{2009}(").then(&first).up(" − ").then(&second).up(")");
        let angles = if turned_round { [now, free.value] } else { [free.value, now] };
        let set = |n: &[Rich]| {
            let [first, second] = order([n[1].clone(), n[2].clone()]);
            let begin = if angles[0] < 0.0 { "(−" } else { "(" };
            let between = if angles[1] < 0.0 { " + " } else { " − " };
            n[0].clone().up(TIMES).up(begin).then(&first).up(between).then(&second).up(")")
        };
        let together = (torque.si - 1.0).abs() < 1e-12;
        let reckon = |n: &[f64]| {
            let of_spring = n[0] * (n[1].copysign(free.value) - n[2].copysign(now));
            if turned_round { -of_spring } else { of_spring }
        };
        let line = self.line_in(together, name, formula, &factors, set, reckon, (result, torque));
        Some(if self.asks(Force::Twist(of.spring)) { line } else { line.word(self.n.sense(exerted)) })
    }

    /// Whether a force is asked by itself.
    fn asks(&self, force: Force) -> bool {
        self.n.mechanism().asked.iter().any(|asked| asked.quantity == Quantity::Force(force, Share::Total))
    }

    fn line_of_area(
        &self,
        formula: Rich,
        factors: &[Factor<'_>],
        set: impl Fn(&[Rich]) -> Rich,
        reckon: impl Fn(&[f64]) -> f64,
        result: Factor<'_>,
    ) -> Rich {
        // π belongs to the numbers, not to the units: those of lengths always go together.
        let values: Vec<(Option<Key>, f64, &Unit)> =
            factors.iter().map(|factor| (factor.key, factor.si, factor.unit)).collect();
        let result = (result.key, result.si, result.unit);
        let (written, text, _) = self.figures.borrow_mut().line_of(&values, result, &reckon);
        let of = Rich::italic("A").up(EQUALS).then(&formula).up(EQUALS);
        of.then(&set(&written)).up(EQUALS).then(&human::with_unit(&text, &result.2.symbol))
    }

    /// The weight of a link, its inertia force against the acceleration of G, its torque against ε, their offset.
    fn mass(&self, own: &MassForces) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let a = self.acceleration();
        let number = self.n.number(own.link);
        let forces = &self.n.mechanism().forces;
        let Some(stated) = forces.mass(own.link) else { return Vec::new() };
        let g = forces.gravity.g.value;
        let name = |letter: &str| Rich::italic(letter).sub(&number);
        let force = |force: Force| self.n.symbol(Quantity::Force(force, Share::Total), false);
        let mut lines = Vec::new();
        let turning = own.alpha.filter(|alpha| *alpha != 0.0 && own.inertia.is_some());
        // Pounds of force are no pounds of mass: there the force is W/g A, and the torque W/g ρ² ε.
        let tens = libm::log10(units.force.si);
        let by_weight = match stated.heaviness {
            Heaviness::Weight(weight) if (tens - libm::round(tens)).abs() > 1e-9 => Some(weight.value),
            _ => None,
        };
        let w = self.n.angular_unit(Order::Acceleration);
        let torque_by_weight = match (by_weight, stated.inertia) {
            (Some(weight), Inertia::Gyration(radius)) => {
                let per = units.force.si / a.si * units.length.si * units.length.si * w.si;
                ((per / units.torque.si - 1.0).abs() < 1e-9).then_some((weight, radius.value))
            }
            _ => None,
        };
        let weight_over_g = |weight: f64| {
            let (text, number) = human::shifted(g / a.si, 0);
            self.figures.borrow_mut().note(Key::Given("g"), &text, (number, g / a.si), &a);
            [
                Factor::new(weight, &units.force, "N").of(Key::OfLink("W", own.link)),
                Factor::new(g, &a, "m/s²").of(Key::Given("g")),
            ]
        };
        match (stated.heaviness, own.mass, own.weight) {
            (Heaviness::Weight(weight), Some(mass), _)
                if own.acceleration > 0.0 && by_weight.is_none()
                    || turning.is_some() && torque_by_weight.is_none() =>
            {
                lines.push(self.mass_of_weight(own.link, weight.value, mass));
            }
            (Heaviness::Mass(given), _, Some(weight)) => {
                let factors = [Factor::new(given.value, &units.mass, "kg"), Factor::new(g, &a, "m/s²")];
                let result = Factor::new(weight, &units.force, "N").of(Key::OfLink("W", own.link));
                let formula = name("M").up(DOT).it("g");
                lines.push(self.line(name("W"), formula, &factors, product, |n| n[0] * n[1], result));
            }
            _ => {}
        }
        let mut inertia_force = 0.0;
        if let (Some(mass), true) = (own.mass, own.acceleration > 0.0) {
            lines.extend(self.read_acceleration(own));
            inertia_force = mass * own.acceleration;
            let acceleration = self.n.symbol(Quantity::Acceleration(own.centre), false);
            let read =
                Factor::new(own.acceleration, &a, "m/s²").of(Key::Of(Quantity::Acceleration(own.centre)));
            let result = Factor::new(inertia_force, &units.force, "N")
                .of(self.whole(Force::Vector(Action::Inertia(own.link))));
            let of = force(Force::Vector(Action::Inertia(own.link)));
            let line = if let Some(weight) = by_weight {
                let [weight, g] = weight_over_g(weight);
                let set = |n: &[Rich]| n[0].clone().up(OVER).then(&n[1]).up(TIMES).then(&n[2]);
                let formula = name("W").up(OVER).it("g").up(DOT).then(&acceleration);
                self.line(of, formula, &[weight, g, read], set, |n| n[0] / n[1] * n[2], result)
            } else {
                let mass = Factor::new(mass, &units.mass, "kg").of(Key::OfLink("M", own.link));
                let formula = name("M").up(DOT).then(&acceleration);
                self.line(of, formula, &[mass, read], product, |n| n[0] * n[1], result)
            };
            let against = Rich::fill(self.n.words.against_sense_of, &[("rotation", acceleration)]);
            lines.push(line.aside(self.n.words.comma, &against));
        }
        let (Some(inertia), Some(alpha)) = (own.inertia, turning) else { return lines };
        match (stated.inertia, own.mass) {
            (Inertia::Gyration(radius), Some(mass)) if torque_by_weight.is_none() => {
                let factors = [
                    Factor::new(mass, &units.mass, "kg").of(Key::OfLink("M", own.link)),
                    Factor::new(radius.value, &units.length, "m"),
                ];
                let result = Factor::new(inertia, &units.inertia, "kg·m²").of(Key::OfLink("I", own.link));
                let formula = name("M").up(DOT).then(&name("ρ").squared());
                let set = |n: &[Rich]| n[0].clone().up(TIMES).then(&squared(&n[1]));
                lines.push(self.line(name("I"), formula, &factors, set, |n| n[0] * n[1] * n[1], result));
            }
            (Inertia::About(point, given), Some(mass)) if point != own.centre => {
                let away = libm::sqrt(((given.value - inertia) / mass).max(0.0));
                let factors = [
                    Factor::new(given.value, &units.inertia, "kg·m²"),
                    Factor::new(mass, &units.mass, "kg").of(Key::OfLink("M", own.link)),
                    Factor::new(away, &units.length, "m"),
                ];
                let result = Factor::new(inertia, &units.inertia, "kg·m²").of(Key::OfLink("I", own.link));
                let about = Rich::italic("I").sub(&format!("{number},{}", self.n.index(point)));
                let d = self.n.length(point, own.centre);
                let formula = about.up(" − ").then(&name("M")).up(DOT).then(&d).up("²");
                let set = |n: &[Rich]| n[0].clone().up(" − ").then(&n[1]).up(TIMES).then(&squared(&n[2]));
                // In units that go together or in SI: the difference needs one unit.
                lines.push(self.line(
                    name("I"),
                    formula,
                    &factors,
                    set,
                    |n| n[0] - n[1] * n[2] * n[2],
                    result,
                ));
            }
            _ => {}
        }
        let torque = inertia * alpha;
        let rate = Factor::new(alpha.abs(), &w, "rad/s²").of(Key::Of(Quantity::Alpha(own.link)));
        let result =
            Factor::new(torque.abs(), &units.torque, "N·m").of(self.whole(Force::InertiaTorque(own.link)));
        let of = force(Force::InertiaTorque(own.link));
        let alpha = self.n.symbol(Quantity::Alpha(own.link), false);
        let line = if let Some((weight, radius)) = torque_by_weight {
            let [weight, g] = weight_over_g(weight);
            let factors = [weight, g, Factor::new(radius, &units.length, "m"), rate];
            let set = |n: &[Rich]| {
                let mass = n[0].clone().up(OVER).then(&n[1]);
                mass.up(TIMES).then(&squared(&n[2])).up(TIMES).then(&n[3])
            };
            let mass = name("W").up(OVER).it("g");
            let formula = mass.up(DOT).then(&name("ρ").squared()).up(DOT).then(&alpha);
            self.line(of.clone(), formula, &factors, set, |n| n[0] / n[1] * n[2] * n[2] * n[3], result)
        } else {
            let inertia = Factor::new(inertia, &units.inertia, "kg·m²").of(Key::OfLink("I", own.link));
            let formula = name("I").up(DOT).then(&alpha);
            self.line(of.clone(), formula, &[inertia, rate], product, |n| n[0] * n[1], result)
        };
        lines.push(line.word(self.n.sense(-torque)));
        if inertia_force > 0.0 {
            let factors = [
                Factor::new(torque.abs(), &units.torque, "N·m")
                    .of(self.whole(Force::InertiaTorque(own.link))),
                Factor::new(inertia_force, &units.force, "N")
                    .of(self.whole(Force::Vector(Action::Inertia(own.link)))),
            ];
            let result = Factor::new(torque.abs() / inertia_force, &units.length, "m")
                .of(self.whole(Force::Offset(own.link)));
            let formula = of.up(OVER).then(&force(Force::Vector(Action::Inertia(own.link))));
            let h = force(Force::Offset(own.link));
            lines.push(self.line(h, formula, &factors, quotient, |n| n[0] / n[1], result));
        }
        lines
    }

    /// M = W / g.
    pub(super) fn mass_of_weight(&self, link: LinkId, weight: f64, mass: f64) -> Rich {
        let units = &self.n.scene.units;
        let g = self.n.mechanism().forces.gravity.g.value;
        let a = self.acceleration();
        let name = |letter: &str| Rich::italic(letter).sub(&self.n.number(link));
        let weight = Factor::new(weight, &units.force, "N").of(Key::OfLink("W", link));
        let factors = [weight, Factor::new(g, &a, "m/s²")];
        let result = Factor::new(mass, &units.mass, "kg").of(Key::OfLink("M", link));
        let formula = name("W").up(OVER).it("g");
        self.line(name("M"), formula, &factors, quotient, |n| n[0] / n[1], result)
    }

    /// The acceleration of a mass centre, read off its image.
    fn read_acceleration(&self, own: &MassForces) -> Option<Rich> {
        let polygon = self.construction.diagram(DiagramKind::Acceleration)?;
        let quantity = Quantity::Acceleration(own.centre);
        if self.figures.borrow().has(Key::Of(quantity)) {
            return None;
        }
        let image = polygon.image_of(own.centre, self.n.mechanism())?.label;
        let mm = own.acceleration / polygon.si_per_mm;
        let name = self.n.symbol(quantity, false);
        let told = (&mut *self.figures.borrow_mut(), Key::Of(quantity));
        Some(super::steps::read(
            name,
            [Label::Pole, image],
            (mm, is_a_point(mm)),
            own.acceleration,
            polygon,
            self.n,
            told,
        ))
    }

    fn body_name(&self, body: &FreeBody) -> Rich {
        match body.of {
            Party::Link(_) => self.n.links(&body.links()),
            Party::Pin(pin) => self.n.point(pin),
        }
    }

    /// That several links have two forces together, whose line is that of their ends; and that what is asked there is zero.
    fn members(&self, index: usize) -> Vec<Rich> {
        let words = self.n.words;
        let mut lines = Vec::new();
        for member in self.sheet.members.iter().filter(|member| member.told == index) {
            let [a, b] = member.ends;
            let parts = [("links", self.n.links(&member.links)), ("line", self.n.length(a, b))];
            lines.push(Rich::fill(words.two_forces, &parts));
            let zero = |asked: &&Asked| {
                matches!(asked.quantity, Quantity::Force(Force::Vector(action @ Action::Pair { by, on }), share)
                if share == self.share && match member.links.len() {
                    1 => member.links.contains(&by) != member.links.contains(&on) && !self.acts(action),
                    _ => member.links.contains(&by) && member.links.contains(&on) && !self.acts(action),
                })
            };
            for asked in self.n.mechanism().asked.iter().filter(zero) {
                let vector = self.n.symbol(asked.quantity, false);
                lines.push(Rich::fill(words.force_is_zero, &[("vector", vector)]));
            }
        }
        lines
    }

    /// Whether a force, or its reaction, is on a body.
    fn acts(&self, action: Action) -> bool {
        let all = self.sheet.bodies.iter().flat_map(|body| &body.acting);
        all.into_iter().any(|acting| either(acting.action) == either(action))
    }

    /// What rubs at a pair before its force is drawn: the angle of friction, the circle, the sense, and the line.
    fn friction(&self, index: usize) -> Vec<Item> {
        let words = self.n.words;
        let Some(touch) = self.sheet.rubs.get(index) else { return Vec::new() };
        let mut lines = Vec::new();
        let place = super::friction::place_name(touch, self.n);
        let phi = Rich::italic("φ").sub(&place);
        let angle = |of: Roughness| match of {
            Roughness::Coefficient(f) => {
                let line = phi.clone().up(EQUALS).up("arctan\u{a0}").then(&human::stated(f.value));
                (line.up(EQUALS).then(&super::friction::fine_degrees(of.angle())), of.angle())
            }
            Roughness::Angle(angle) => {
                (phi.clone().up(EQUALS).then(&human::degrees(angle.value)), angle.value)
            }
        };
        let friction = &self.n.mechanism().forces.friction;
        match touch.rub.pair {
            RubbingPair::Pin { pin, .. } => {
                if let Some(FrictionCircle::Journal { radius, roughness }) = friction.circle(pin) {
                    let (line, angle) = angle(roughness);
                    let told = if matches!(roughness, Roughness::Coefficient(_)) {
                        super::friction::fine_degrees(angle)
                    } else {
                        human::degrees(angle)
                    };
                    let unit = &self.n.scene.units.length;
                    let name = |letter: &str, mark: &str| Rich::italic(letter).sub(&format!("{mark}{place}"));
                    let formula = name("r", "").up("\u{a0}sin\u{a0}").then(&phi);
                    let factors = [Factor::new(radius.value, unit, "m")];
                    let by = self.sheet.rubs[index].between;
                    let arm = Force::Arm(either(Action::Pair { by: by[1], on: by[0] }), pin);
                    let result = Factor::new(touch_radius(touch.rub.by), unit, "m")
                        .of(Key::Of(Quantity::Force(arm, self.share)));
                    let set = |n: &[Rich]| n[0].clone().up(TIMES).up("sin\u{a0}").then(&told);
                    let reckon = |n: &[f64]| n[0] * libm::sin(angle);
                    if matches!(roughness, Roughness::Coefficient(_)) {
                        lines.push(line);
                    }
                    let of = name("r", "f,");
                    lines.push(self.line_in(true, of, formula, &factors, set, reckon, (result, unit)));
                }
            }
            RubbingPair::Slide(slide) => {
                if let Some(of @ Roughness::Coefficient(_)) =
                    friction.resistance(slide).and_then(|resistance| resistance.roughness())
                {
                    lines.push(angle(of).0);
                }
            }
        }
        lines.extend(self.turns_on(touch));
        lines.push(super::friction::sentence(index, self.sheet, self.n));
        if self.sheet.passes > 1 && super::friction::first(self.sheet) == Some(index) {
            let count = ("count", Rich::upright(self.sheet.passes.to_string()));
            lines.push(Rich::fill(words.friction_passes, &[count]));
        }
        let head = self.head(super::friction::title(index, self.sheet, self.n));
        std::iter::once(head).chain(lines.into_iter().map(Item::Sentence)).collect()
    }

    /// How a link turns on the one that carries it, where both turn.
    fn turns_on(&self, touch: &Touch) -> Option<Rich> {
        let [own, other] = touch.rates?;
        if own == 0.0 && other == 0.0 || touch.between.contains(&LinkId::FRAME) {
            return None;
        }
        let [link, carrier] = touch.between;
        let unit = self.n.angular_unit(Order::Velocity);
        let factor = |link: LinkId, value: f64| {
            Factor::new(value.abs(), &unit, "rad/s").of(Key::Of(Quantity::Omega(link)))
        };
        let signs = [own, other].map(|value| if value < 0.0 { -1.0 } else { 1.0 });
        let factors = [factor(link, own), factor(carrier, other)];
        let relative = own - other;
        let set = |n: &[Rich]| {
            let first = if own < 0.0 { Rich::upright("−").then(&n[0]) } else { n[0].clone() };
            let second = if other < 0.0 { Rich::upright("(−").then(&n[1]).up(")") } else { n[1].clone() };
            first.up(" − ").then(&second)
        };
        let reckon = |n: &[f64]| n[0] * signs[0] - n[1] * signs[1];
        let name = |links: &[LinkId]| {
            let numbers: Vec<String> = links.iter().map(|link| self.n.number(*link)).collect();
            Rich::italic("ω").sub(&numbers.concat())
        };
        let formula = name(&[link]).up(" − ").then(&name(&[carrier]));
        let result = Factor::new(relative, &unit, "rad/s");
        // The sign tells the sense: both together would tell it twice, the second time the other way round.
        Some(self.line_in(true, name(&[link, carrier]), formula, &factors, set, reckon, (result, &unit)))
    }

    /// A body: its balance, moments that give a size, the polygon that gives the rest.
    fn body(&self, index: usize) -> Vec<(ForcePanel, Vec<Item>)> {
        let Some(body) = self.sheet.bodies.get(index) else { return Vec::new() };
        let mut parts: Vec<(ForcePanel, Vec<Item>)> = Vec::new();
        let words = self.n.words;
        let head = match body.of {
            Party::Link(_) => Rich::fill(words.step_forces, &[("links", self.body_name(body))]),
            Party::Pin(_) => Rich::fill(words.step_forces_pin, &[("point", self.body_name(body))]),
        };
        let mut items = vec![self.head(head)];
        self.hand_on();
        items.push(Item::Terms(self.balance(index)));
        if let [one, other] = &body.acting[..]
            && body.torques.is_empty()
        {
            // One is the other turned round: their line is that of their points.
            let known = one.known == Knowledge::Full
                || other.known == Knowledge::Full
                || self.sheet.friction_axis(body).is_some();
            let line = body.acting.iter().all(|acting| acting.couple == 0.0);
            if let (false, true, Party::Link(link)) = (known, line, body.of) {
                let points: Vec<_> = self.n.mechanism().link(link).points.iter().take(2).collect();
                if let [a, b] = points[..] {
                    let parts = [("links", self.body_name(body)), ("line", self.n.length(*a, *b))];
                    items.push(Item::Sentence(Rich::fill(words.two_forces, &parts)));
                }
            }
        }
        items.extend(self.names_at_pins(index).into_iter().map(Item::Sentence));
        items.extend(self.members(index).into_iter().map(Item::Sentence));
        let drags = super::friction::drags_before(index, self.sheet);
        items.extend(drags.map(|rub| Item::Sentence(super::friction::sentence(rub, self.sheet, self.n))));
        items.extend(self.contacts(body).into_iter().map(Item::Sentence));
        items.extend(self.governor_body(index, false));
        items.extend(self.three_forces(index).into_iter().map(Item::Sentence));
        let trials = self.sheet.group_trials.iter().filter(|trial| trial.told == index);
        items.extend(trials.map(|trial| Item::Sentence(self.group_trial(trial))));
        // Bodies that are told together: what hangs on forces that only their polygons give comes after these.
        let before = self.sheet.bodies[..index].iter().rev().take_while(|body| body.with_next).count();
        let after = self.sheet.bodies[index..].iter().take_while(|body| body.with_next).count();
        let together = &self.sheet.bodies[index - before..=(index + after).min(self.sheet.bodies.len() - 1)];
        let closes = |of: Turning| {
            let given = |action: Action, acting: &Acting| either(acting.action) == either(action);
            matches!(of, Turning::Force(action) if together
                .iter()
                .flat_map(|body| &body.acting)
                .any(|acting| given(action, acting) && acting.closes))
        };
        let later = |moments: &MomentBalance| {
            matches!(moments.found.of, Turning::Torque(_)) && moments.terms.iter().any(|term| closes(term.of))
        };
        let told = |later_ones: bool| {
            let plain = self.sheet.governor.is_none();
            let first = if later_ones { index - before } else { index };
            let own = self.sheet.moments.iter();
            let own = own.filter(move |moments| plain && (first..=index).contains(&moments.told));
            own.filter(move |moments| later(moments) == later_ones)
        };
        // Each part is told beside the figure that shows it.
        let panels = ForcePanel::all(self.sheet);
        let own_panel = |moments: &MomentBalance| {
            let place = self.sheet.moments.iter().position(|own| std::ptr::eq(own, moments))?;
            Some(ForcePanel::Together(place)).filter(|panel| panels.contains(panel))
        };
        let mut panel = ForcePanel::Body(index);
        // Where the line of a force lies is told with its moment, or as soon as its size is read.
        let mut waiting: Vec<&MomentBalance> = Vec::new();
        for moments in told(false) {
            if let Some(own) = own_panel(moments) {
                parts.push((panel, std::mem::take(&mut items)));
                panel = own;
            }
            items.extend(self.moments(moments).into_iter().map(Item::Sentence));
            match self.displaced(moments, index) {
                Some(line) => items.push(Item::Sentence(line)),
                None => waiting.push(moments),
            }
        }
        items.extend(self.of_both_parts(index).into_iter().map(Item::Sentence));
        for (link, axis) in super::friction::axes_told(index, self.sheet) {
            let template = match axis {
                FrictionAxis::Outer => words.friction_axis_outer,
                FrictionAxis::Inner => words.friction_axis_inner,
            };
            let link = [("link", Rich::upright(self.n.number(link)))];
            items.push(Item::Sentence(Rich::fill(template, &link)));
        }
        let by_lines = super::governor::without_polygon(self.sheet, index);
        if let ([one, other], false) = (&body.acting[..], by_lines || self.equal_at(index) != index) {
            items.extend(self.equal(one, other).map(Item::Sentence));
        }
        if body.with_next {
            parts.push((panel, items));
            return parts;
        }
        // The polygon of a link on legs gives what closes theirs; so does that of a driven link on rods.
        let first = body.gives.then_some(index);
        let last = first.map_or(index + 1, |first| first);
        for k in first.into_iter().chain(index - before..last) {
            let own = ForcePanel::Polygon(k);
            if panels.contains(&own) {
                parts.push((panel, std::mem::take(&mut items)));
                panel = own;
            }
            items.extend(self.polygon(k).into_iter().map(Item::Sentence));
            items.extend(self.split(k).into_iter().map(Item::Sentence));
        }
        items.extend(self.governor_body(index, true));
        // What is the other force of an earlier body turned round, once that is known.
        for earlier in (0..index).filter(|earlier| self.equal_at(*earlier) == index) {
            if let ([one, other], false) = (
                &self.sheet.bodies[earlier].acting[..],
                super::governor::without_polygon(self.sheet, earlier),
            ) {
                items.extend(self.equal(one, other).map(Item::Sentence));
            }
        }
        items.extend(waiting.iter().filter_map(|moments| self.displaced(moments, index)).map(Item::Sentence));
        for moments in told(true) {
            if let Some(own) = own_panel(moments) {
                parts.push((panel, std::mem::take(&mut items)));
                panel = own;
            }
            items.extend(self.moments(moments).into_iter().map(Item::Sentence));
            items.extend(self.displaced(moments, index).map(Item::Sentence));
        }
        parts.push((panel, items));
        parts
    }

    /// The body at which it is told that the two forces on a body are one turned round: that at which the polygon gives the
    /// one of which moments have given a part; else the body itself.
    fn equal_at(&self, index: usize) -> usize {
        let bodies = &self.sheet.bodies;
        let [one, other] = &bodies[index].acting[..] else { return index };
        let known = if one.closes { other } else { one };
        let same = |action: Action| either(action) == either(known.action);
        let in_parts = self.sheet.moments.iter().any(|moments| match moments.found.of {
            Turning::Across(action) => moments.told == index && same(action),
            _ => false,
        });
        let mut later = (index + 1..bodies.len()).filter(|later| !bodies[*later].with_next);
        let gives = |later: &usize| bodies[*later].acting.iter().any(|acting| same(acting.action));
        // Told together with it, a body whose polygon is laid off first.
        let together = |later: usize| {
            bodies[later].gives && bodies[index..later].iter().all(|between| between.with_next)
        };
        later.find(gives).filter(|later| in_parts || together(*later)).unwrap_or(index)
    }

    /// Three forces that meet in a point: of a force with a couple first how far it is displaced.
    fn three_forces(&self, index: usize) -> Vec<Rich> {
        let Some(meet) = self.sheet.meets.iter().find(|meet| meet.told == index) else { return Vec::new() };
        let Some(body) = self.sheet.bodies.get(index) else { return Vec::new() };
        let (found, known): (Vec<&Acting>, Vec<&Acting>) =
            body.acting.iter().partition(|acting| acting.closes);
        let names = |list: &[&Acting]| {
            let names: Vec<Rich> = list.iter().map(|acting| self.symbol(acting.action)).collect();
            self.n.list(&names)
        };
        let resultant = super::forces::resultant_name(meet.link, self.n);
        let couples = super::forces::couples_on(body);
        let displaced = match (&known[..], &couples[..]) {
            ([force], [(couple, moment)]) => {
                let units = &self.n.scene.units;
                let size = libm::hypot(force.force[0], force.force[1]);
                let factors = [
                    Factor::new(moment.abs(), &units.torque, "N·m").of(self.whole(*couple)),
                    Factor::new(size, &units.force, "N").of(self.whole(Force::Vector(force.action))),
                ];
                let formula =
                    symbol(Turning::Torque(*couple), self.n).up(OVER).then(&self.symbol(force.action));
                let result = Factor::new(moment.abs() / size, &units.length, "m");
                let own = Rich::italic("d").sub(&self.n.number(meet.link));
                let equation = self.line(own, formula, &factors, quotient, |n| n[0] / n[1], result);
                let parts = [
                    ("force", self.symbol(force.action)),
                    ("resultant", resultant.clone()),
                    ("equation", equation),
                ];
                Some(Rich::fill(self.n.words.displaced_by_couple, &parts))
            }
            _ => None,
        };
        // What was displaced has its new name.
        let one = displaced.is_some();
        let parts = [
            ("known", if one { resultant.clone() } else { names(&known) }),
            ("found", names(&found)),
            ("point", super::forces::meet_name(meet.link, self.n)),
            ("resultant", resultant),
        ];
        let template = match known.len() {
            0 | 1 => self.n.words.three_forces,
            _ => self.n.words.three_forces_resultant,
        };
        displaced.into_iter().chain([Rich::fill(template, &parts)]).collect()
    }

    /// How the forces of rolling pairs point that are not known yet.
    fn contacts(&self, body: &FreeBody) -> Vec<Rich> {
        let words = self.n.words;
        let m = self.n.mechanism();
        let Party::Link(link) = body.of else { return Vec::new() };
        let mut told = Vec::new();
        for roll in (0..m.rolls.len()).filter(|roll| m.rolls[*roll].bodies().contains(&link)) {
            let action = m.force_of_roll(roll, link);
            let unknown = |acting: &&Acting| acting.action == action && acting.known != Knowledge::Full;
            let Some(acting) = body.acting.iter().find(unknown) else { continue };
            let force = ("force", self.symbol(acting.action));
            let template = match (self.sheet.contacts.contains(&roll), m.forces.pressure(roll)) {
                (true, _) => Rich::fill(words.contact_presses, &[force]),
                (false, Some(pressure)) => {
                    let angle = ("angle", human::degrees(pressure.value));
                    Rich::fill(words.teeth_press, &[force, angle])
                }
                (false, None) => Rich::fill(words.along_tangent, &[force]),
            };
            told.push(template);
        }
        told
    }

    /// What a group of higher class leaves open.
    fn group_trial(&self, trial: &GroupTrial) -> Rich {
        let words = self.n.words;
        let m = self.n.mechanism();
        let of = |closing: Closing| -> (Rich, bool) {
            let part = |action: Action| super::force_names::part(self.n, action, self.n.profile.normal);
            let between = |near: PointId, link: LinkId| {
                let parties = m.parties_at(near);
                match parties[..] {
                    [one, other] => Action::Pair { by: if one == link { other } else { one }, on: link },
                    _ => Action::OfPin(near, link),
                }
            };
            let force = |action: Action| self.symbol(action);
            match closing {
                Closing::Rod { link, near, .. } => (part(between(near, link)), false),
                Closing::Slide { slide, pin } => {
                    let guide = m.slides[slide].guide.link;
                    match m.party_of(&m.slides[slide].rider) {
                        Party::Link(rider) => (force(Action::Pair { by: guide, on: rider }), false),
                        Party::Pin(_) => (force(Action::OnPin(guide, pin)), false),
                    }
                }
                Closing::Angle { input, .. } => {
                    (self.n.symbol(Quantity::Force(Force::Torque(input), Share::Total), false), true)
                }
                Closing::Driven { input, .. } => {
                    (self.n.symbol(Quantity::Force(Force::Drive(input), Share::Total), false), false)
                }
                Closing::Contact { roll, .. } | Closing::Roll { roll } => {
                    let [_, on] = m.rolls[roll].bodies();
                    (force(m.force_of_roll(roll, on)), false)
                }
            }
        };
        let held = |driver: TrialDriver| match driver {
            TrialDriver::Turn(link) => (self.n.links(&[link]), true),
            TrialDriver::Slide(slide) => {
                let pin = match m.slides[slide].rider {
                    crate::mechanism::Rider::Pin { point, .. } => Some(point),
                    crate::mechanism::Rider::Link { link, .. } => m.link(link).points.first().copied(),
                };
                (pin.map(|pin| self.n.point(pin)).unwrap_or_default(), false)
            }
        };
        let value = |size: f64, turns: bool| if turns { self.torque(size) } else { self.force(size) };
        if let (&[(driver, closing, size)], Some([loads, by_unit])) = (&trial.found[..], trial.efforts) {
            let ((symbol, couple), (driver, turns)) = (of(closing), held(driver));
            let parts = [
                ("force", symbol),
                ("driver", driver),
                ("first", value(loads, turns)),
                ("tried", value(1.0, couple)),
                ("second", value(by_unit, turns)),
                ("value", value(size, couple)),
            ];
            return Rich::fill(words.group_trial, &parts);
        }
        let all = trial.found.iter().map(|&(driver, closing, size)| {
            let (symbol, couple) = of(closing);
            (symbol.up(EQUALS).then(&value(size, couple)), held(driver).0)
        });
        let (forces, drivers): (Vec<Rich>, Vec<Rich>) = all.unzip();
        let list = |all: &[Rich]| Rich::join(all, &Rich::upright(words.comma));
        Rich::fill(words.group_trials, &[("forces", list(&forces)), ("drivers", list(&drivers))])
    }

    /// Of two forces that one that is not known yet: the other turned round.
    fn equal(&self, one: &Acting, other: &Acting) -> Option<Rich> {
        let (known, found) = match (one.closes, other.closes) {
            (false, true) => (one, other),
            (true, false) => (other, one),
            _ => return None,
        };
        let unit = &self.n.scene.units.force;
        let size = libm::hypot(found.force[0], found.force[1]);
        let [of, is] = [found, known].map(|acting| self.whole(Force::Vector(acting.action)));
        let size = {
            let mut figures = self.figures.borrow_mut();
            let number = figures.tell(is, size, unit);
            figures.alias(of, is);
            human::with_unit(&number, &unit.symbol)
        };
        // What drives is told by its own name on either side.
        let drive = |acting: &Acting| match acting.action {
            Action::DriveBack(input) => Some(self.symbol(Action::Drive(input))),
            _ => None,
        };
        let equal = match (drive(found), drive(known)) {
            (Some(drive), _) => drive.up(EQUALS).then(&self.symbol(known.action)),
            (None, Some(drive)) => self.symbol(found.action).up(EQUALS).then(&drive),
            (None, None) => {
                self.symbol(found.action).up("\u{a0}= −\u{2009}").then(&self.symbol(known.action))
            }
        };
        let [x, y] = found.force;
        if found.force == [0.0; 2] {
            return Some(equal.up(EQUALS).up("0."));
        }
        let angle = Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(y, x)));
        Some(equal.up(self.n.words.semicolon).then(&size).up(self.n.words.comma).then(&angle).up("."))
    }

    /// What was sought elsewhere than at the input.
    fn sought(&self, of: Sought) -> (Rich, Unit) {
        let units = &self.n.scene.units;
        let forces = &self.n.mechanism().forces;
        match of {
            Sought::Load(index) => {
                let unit = if forces.loads[index].is_torque() { &units.torque } else { &units.force };
                (super::force_names::load(self.n, index), unit.clone())
            }
            Sought::Spring(index) => {
                let spring = &forces.springs[index];
                let stiffness = || Rich::italic("K").sub(&spring.name);
                let symbol = |force| self.n.symbol(Quantity::Force(force, Share::Total), false);
                match (spring.kind, spring.law) {
                    (SpringKind::Pull(_), SpringLaw::Stiffness { .. }) => {
                        (stiffness(), units.stiffness.clone())
                    }
                    (SpringKind::Pull(_), SpringLaw::Force(_)) => {
                        (symbol(Force::Pull(index)), units.force.clone())
                    }
                    (SpringKind::Torsion(_), SpringLaw::Stiffness { .. }) => {
                        (stiffness(), Unit { symbol: "N*m/rad".to_owned(), si: 1.0 })
                    }
                    (SpringKind::Torsion(_), SpringLaw::Force(_)) => {
                        (symbol(Force::Twist(index)), units.torque.clone())
                    }
                }
            }
            Sought::Spin => (Rich::italic("ω").squared(), Unit { symbol: "(rad/s)^2".to_owned(), si: 1.0 }),
            Sought::Effort(_) => (Rich::default(), units.force.clone()),
        }
    }

    /// Several unknowns: each tried alone, and what they come to.
    fn trials(&self, trials: &Trials) -> Vec<Rich> {
        let inputs = 0..trials.without.len();
        let turns = |input: usize| self.n.mechanism().driven_link(input).is_some();
        let symbol = |input: usize| {
            let force = if turns(input) { Force::Torque(input) } else { Force::Drive(input) };
            self.n.symbol(Quantity::Force(force, Share::Total), false)
        };
        let equals = |symbol: Rich, value: &Rich| symbol.up(EQUALS).then(value);
        let list = |parts: Vec<Rich>| Rich::join(&parts, &Rich::upright(self.n.words.comma));
        let efforts = |values: &[f64]| {
            let told = inputs.clone().zip(values).map(|(input, value)| {
                let value = if turns(input) { self.torque(*value) } else { self.force(*value) };
                equals(symbol(input), &value)
            });
            list(told.collect())
        };
        // What is sought is tried in a size of its own order, for which efforts grow in proportion.
        let tried = |(sought, size): &(Sought, f64)| {
            let (symbol, unit) = self.sought(*sought);
            let power = libm::pow(10.0, libm::floor(libm::log10((size / unit.si).abs())));
            let tried = if power.is_normal() { libm::copysign(power, *size) } else { 1.0 } * unit.si;
            (symbol, unit, tried)
        };
        let zero = Rich::upright("0");
        let with = |only: Option<usize>| {
            let told = trials.sought.iter().enumerate().map(|(index, of)| {
                let (symbol, unit, tried) = tried(of);
                match only {
                    Some(only) if only == index => equals(symbol, &human::quantity(tried, &unit)),
                    _ => equals(symbol, &zero),
                }
            });
            list(told.collect())
        };
        let say = |loads: Rich, efforts: Rich| {
            Rich::fill(self.n.words.force_trials, &[("loads", loads), ("efforts", efforts)])
        };
        let mut lines = vec![say(with(None), efforts(&trials.without))];
        for (index, (of, unit_efforts)) in trials.sought.iter().zip(&trials.with).enumerate() {
            let (_, _, size) = tried(of);
            let grown = trials.without.iter().zip(unit_efforts);
            let grown: Vec<f64> =
                grown.map(|(none, one)| none + (one - none) * (size / trials.tried)).collect();
            lines.push(say(with(Some(index)), efforts(&grown)));
        }
        let found = trials.sought.iter().map(|(sought, size)| {
            let (symbol, unit) = self.sought(*sought);
            equals(symbol, &human::quantity(*size, &unit))
        });
        let gone = list(inputs.clone().map(|input| equals(symbol(input), &zero)).collect());
        let parts = [("loads", list(found.collect())), ("efforts", gone)];
        lines.push(Rich::fill(self.n.words.force_trials_found, &parts));
        lines
    }

    fn trial(&self, trial: &crate::graphical::construction::Trial) -> Rich {
        let units = &self.n.scene.units;
        let (symbol, unit) = self.sought(trial.sought);
        let unit = &unit;
        let turns = self.n.mechanism().driven_link(0).is_some();
        let effort = |value: f64| if turns { self.torque(value) } else { self.force(value) };
        let input = if turns { Force::Torque(0) } else { Force::Drive(0) };
        // The effort is linear in what is sought: a trial of its order shows it best.
        let power = libm::pow(10.0, libm::floor(libm::log10((trial.size / unit.si).abs())));
        let tried = if power.is_normal() { libm::copysign(power, trial.size) } else { 1.0 };
        let [first, unit_effort] = trial.efforts;
        let second = first + (unit_effort - first) * (tried * unit.si / trial.tried);
        let same = first * second >= 0.0;
        let of_effort = if turns { &units.torque } else { &units.force };
        let values = [tried.abs(), first.abs() / of_effort.si, second.abs() / of_effort.si];
        let reckon = |n: &[f64]| n[0] * n[1] / if same { n[1] - n[2] } else { n[1] + n[2] };
        let size = trial.size / unit.si;
        let numbers = human::closing_all(&values, size.abs(), |n| reckon(n).abs());
        let sign = if same { " − " } else { " + " };
        let quotient = numbers[0]
            .clone()
            .up(TIMES)
            .then(&numbers[1])
            .up(OVER)
            .up("(")
            .then(&numbers[1])
            .up(sign)
            .then(&numbers[2])
            .up(")");
        let quotient = if size < 0.0 { Rich::upright("−").then(&quotient) } else { quotient };
        let parts = [
            ("load", symbol),
            ("tried", human::quantity(tried * unit.si, unit)),
            ("effort", self.n.symbol(Quantity::Force(input, Share::Total), false)),
            ("first", effort(first)),
            ("second", effort(second)),
            ("value", quotient.up(EQUALS).then(&human::quantity(trial.size, unit))),
        ];
        Rich::fill(self.n.words.force_trial, &parts)
    }

    /// The balance with the table of its terms.
    fn balance(&self, index: usize) -> Table {
        let body = &self.sheet.bodies[index];
        let words = self.n.words;
        let unit = &self.n.scene.units.force;
        let label = |word: &str| Rich::italic(word);
        let mut table = Table {
            columns: vec![Align::Left],
            head: vec![Rich::default()],
            rows: vec![
                vec![label(words.magnitude).up(words.comma).up(&human::pretty(&unit.symbol))],
                vec![label(words.line_of_action)],
            ],
            size: 3.3,
            gap: 2.2,
            flow: if words.right_to_left { Flow::LabelsRight } else { Flow::Rightward },
        };
        let mut column = |head: Rich, cells: [Rich; 2]| {
            table.columns.push(Align::Middle);
            table.head.push(head);
            table.rows.iter_mut().zip(cells).for_each(|(row, cell)| row.push(cell));
        };
        let unknown = || Rich::upright(words.unknown);
        for (i, acting) in body.acting.iter().enumerate() {
            // What drives acts back on what carries the guide: that force is taken away.
            let back = match acting.action {
                Action::DriveBack(input) if i > 0 => Some(Action::Drive(input)),
                _ => None,
            };
            if i > 0 {
                let sign = if back.is_some() { "−" } else { "+" };
                column(Rich::upright(sign), [Rich::default(), Rich::default()]);
            }
            if let (Some(parts), true) = (acting.parts, acting.known != Knowledge::Full) {
                let [across, along] = self.columns_of_parts(index, acting, parts);
                column(across.0, across.1);
                column(Rich::upright("+"), [Rich::default(), Rich::default()]);
                column(along.0, along.1);
                continue;
            }
            let size = libm::hypot(acting.force[0], acting.force[1]);
            let told = match acting.known {
                Knowledge::Full => {
                    let key = self.whole(Force::Vector(acting.action));
                    // Of what halves share a part counts, which is told here alone.
                    let number = match self.n.mechanism().halves_of(acting.action) == 1.0 {
                        true => self.figures.borrow_mut().tell(key, size, unit),
                        // A stated load as it is stated, a weight as it was reckoned.
                        false => {
                            let more = usize::from(!matches!(acting.action, Action::Weight(_)));
                            human::limited(size / unit.si, more).0
                        }
                    };
                    Rich::tick().gap(0.15).then(&number)
                }
                _ => unknown(),
            };
            let line = match acting.known {
                Knowledge::Full | Knowledge::Line => Rich::tick(),
                Knowledge::Nothing => unknown(),
            };
            column(super::force_names::laid_off(self.n, back.unwrap_or(acting.action)), [told, line]);
        }
        column(Rich::upright("="), [Rich::default(), Rich::default()]);
        column(Rich::upright("0"), [Rich::default(), Rich::default()]);
        table
    }

    /// The columns of the parts of a force of which moments give one or both: across the line from another pin, and along it.
    fn columns_of_parts(&self, index: usize, acting: &Acting, parts: Parts) -> [(Rich, [Rich; 2]); 2] {
        let unit = &self.n.scene.units.force;
        let column = |part: [f64; 2], is_across: bool| {
            let (mark, sign) = match is_across {
                true => (self.n.profile.tangential, "⊥\u{a0}"),
                false => (self.n.profile.normal, "∥\u{a0}"),
            };
            let key = match is_across {
                true => self.part_key(acting.action),
                false => Key::Part(either(acting.action), false),
            };
            let mut before = self.sheet.moments.iter().filter(|moments| moments.told < index);
            let told = match before.any(|moments| self.key_of(moments.found.of) == key) {
                true => {
                    let size = libm::hypot(part[0], part[1]);
                    Rich::tick().gap(0.15).then(&self.figures.borrow_mut().tell(key, size, unit))
                }
                false => Rich::upright(self.n.words.unknown),
            };
            let [from, to] = parts.line;
            let line = match parts.touches {
                true => Rich::tick(),
                false => Rich::upright(sign).then(&self.n.length(from, to)),
            };
            (super::force_names::part(self.n, acting.action, mark), [told, line])
        };
        [column(parts.across, true), column(parts.along, false)]
    }

    /// Moments about a point: the measured arms, and the quotient or sum with its numbers.
    fn moments(&self, moments: &MomentBalance) -> Vec<Rich> {
        self.moments_with(moments, true)
    }

    /// The same; the arms where they are measured first.
    pub(super) fn moments_with(&self, moments: &MomentBalance, first: bool) -> Vec<Rich> {
        let words = self.n.words;
        let units = &self.n.scene.units;
        let mut lines = Vec::new();
        if let (Some((link, pin)), true) = (moments.carried, first) {
            let parts = [("link", Rich::upright(self.n.number(link))), ("point", self.n.point(pin))];
            lines.push(Rich::fill(words.carried_to_pin, &parts));
        }
        if first {
            lines.extend(self.pin_in_balance(moments));
        }
        let measured = if first { self.arms_of(moments) } else { Vec::new() };
        if !measured.is_empty() {
            let list = Rich::join(&measured, &Rich::upright(words.comma));
            lines.push(Rich::fill(words.measured_arms, &[("list", list)]));
        }
        let sum: f64 = moments.terms.iter().map(|term| term.moment).sum();
        let found = self.name_of(moments.found.of);
        let name_of_place = match moments.about {
            About::Point(point) => self.n.point(point),
            About::Meet { on, of, .. } => {
                let name = super::forces::meet_name(on, self.n);
                // Of what moments have given in part it is the line of the rest.
                let [one, other] = of.map(|action| {
                    let across = |moments: &MomentBalance| match moments.found.of {
                        Turning::Across(other) => either(other) == either(action),
                        _ => false,
                    };
                    match self.sheet.moments.iter().any(across) {
                        true => super::force_names::part(self.n, action, self.n.profile.normal),
                        false => self.symbol(action),
                    }
                });
                let parts = [("one", one), ("other", other), ("point", name.clone())];
                lines.insert(0, Rich::fill(words.lines_meet, &parts));
                name
            }
            About::Contact { pin, .. } => Rich::fill(words.friction_contact, &[("point", self.n.point(pin))]),
            about @ About::Centre { .. } => {
                if let (Some(line), true) = (self.centre_line(about), first) {
                    lines.insert(0, line);
                }
                super::forces::centre_name()
            }
        };
        let place = ("point", name_of_place);
        let links = ("links", self.n.links(&moments.links));
        let tell = |equation: Rich| {
            Rich::fill(words.moments_about, &[links.clone(), place.clone(), ("equation", equation)])
        };
        if moments.terms.is_empty() || sum == 0.0 {
            lines.push(tell(found.up("\u{a0}= 0")));
            return lines;
        }
        if let ([only], None) = (&moments.terms[..], moments.found.arm)
            && only.arm.is_none()
        {
            // One couple balances another: it is that, turned round.
            let [of, is] = [moments.found.of, only.of].map(|of| self.key_of(of));
            let size = {
                let mut figures = self.figures.borrow_mut();
                let number = figures.tell(is, only.size, &units.torque);
                figures.alias(of, is);
                human::with_unit(&number, &units.torque.symbol)
            };
            let equation = found.up(EQUALS).then(&self.name_of(only.of)).up(EQUALS).then(&size);
            lines.push(tell(equation.word(self.n.sense(-sum))));
            return lines;
        }
        let divisor = moments.found.arm.map(|arm| {
            let factor = Factor::new(arm.length, &units.length, "m").of(self.key_of_arm(&arm));
            (arm_name(self.sheet, &arm, self.n), factor)
        });
        let unit = if divisor.is_some() { &units.force } else { &units.torque };
        let name = if divisor.is_some() { "N" } else { "N·m" };
        let size = sum.abs() / moments.found.arm.map_or(1.0, |arm| arm.length);
        let result = Factor::new(size, unit, name).of(self.key_of(moments.found.of));
        let line = self.weighed(found, &moments.terms, divisor, result);
        let sense = self.n.sense(-sum);
        lines.push(tell(if moments.found.arm.is_some() {
            let about = Rich::fill(words.turning_about, &[("sense", Rich::upright(sense)), place.clone()]);
            line.aside(words.comma, &about)
        } else {
            line.word(sense)
        }));
        lines
    }

    /// What the other links exert on the pin of several links is what the pin exerts on this one: where moments take them
    /// one by one and the pin is not cut free.
    fn pin_in_balance(&self, moments: &MomentBalance) -> Vec<Rich> {
        let of_pin = |term: &MomentTerm| match term.of {
            Turning::Force(Action::OnPin(_, pin))
            | Turning::Along(Action::OnPin(_, pin))
            | Turning::Across(Action::OnPin(_, pin)) => Some(pin),
            _ => None,
        };
        let mut pins: Vec<PointId> =
            moments.terms.iter().chain([&moments.found]).filter_map(of_pin).collect();
        pins.sort_unstable();
        pins.dedup();
        let cut_free = |pin: PointId| self.sheet.bodies.iter().any(|body| body.of == Party::Pin(pin));
        let told = pins.into_iter().filter(|pin| !cut_free(*pin)).filter_map(|pin| {
            let parties = self.n.mechanism().parties_at(pin);
            let on = *parties.iter().find(|link| moments.links.contains(link))?;
            let others: Vec<Rich> = parties
                .iter()
                .filter(|link| **link != on)
                .map(|link| self.symbol(Action::OnPin(*link, pin)))
                .collect();
            let equation = self
                .symbol(Action::OfPin(pin, on))
                .up(EQUALS)
                .then(&Rich::join(&others, &Rich::upright(" + ")));
            let parts = [("point", self.n.point(pin)), ("equation", equation)];
            (others.len() > 1).then(|| Rich::fill(self.n.words.pin_balance, &parts))
        });
        told.collect()
    }

    /// What stands in the table as the force of one link on another and is told as that of their pin, and
    /// this.
    fn asked_of_pins(&self) -> Vec<[Action; 2]> {
        let m = self.n.mechanism();
        let asked = m.asked.iter().filter_map(|asked| {
            let Quantity::Force(Force::Vector(pair @ Action::Pair { by, on }), Share::Total) = asked.quantity
            else {
                return None;
            };
            let pin = m.meeting_point(by, on).filter(|pin| m.parties_at(*pin).len() > 2)?;
            let carrier = m.carrier(pin)?;
            let link = if carrier == by { on } else { by };
            [by, on].contains(&carrier).then_some([pair, Action::OfPin(pin, link)])
        });
        asked.collect()
    }

    /// The two names of such a force, where its body comes first.
    fn names_at_pins(&self, index: usize) -> Vec<Rich> {
        let has = |body: &FreeBody, action: Action| body.acting.iter().any(|acting| acting.action == action);
        let mut told = Vec::new();
        for [pair, of_pin] in self.asked_of_pins() {
            if self.sheet.bodies.iter().position(|body| has(body, of_pin)) != Some(index) {
                continue;
            }
            let turned =
                matches!((pair, of_pin), (Action::Pair { by, .. }, Action::OfPin(_, on)) if by == on);
            let sign = if turned { "−" } else { "" };
            told.push(self.symbol(pair).up(EQUALS).up(sign).then(&self.symbol(of_pin)).up("."));
        }
        told
    }

    /// ΣF·arm, those terms first that turn as the sum does, or what it is by a divisor: names, numbers and result.
    fn weighed(
        &self,
        of: Rich,
        terms: &[MomentTerm],
        divisor: Option<(Rich, Factor<'_>)>,
        result: Factor<'_>,
    ) -> Rich {
        let units = &self.n.scene.units;
        let sum: f64 = terms.iter().map(|term| term.moment).sum();
        let against = |term: &MomentTerm| term.moment * sum < 0.0;
        let mut terms: Vec<&MomentTerm> = terms.iter().collect();
        terms.sort_by_key(|term| against(term));
        let mut factors: Vec<Factor<'_>> = Vec::new();
        for term in &terms {
            match term.arm {
                Some(arm) => {
                    factors.push(Factor::new(term.size, &units.force, "N").of(self.key_of(term.of)));
                    factors.push(Factor::new(arm.length, &units.length, "m").of(self.key_of_arm(&arm)));
                }
                None => factors.push(Factor::new(term.size, &units.torque, "N·m").of(self.key_of(term.of))),
            }
        }
        let (by, divisor) = divisor.unzip();
        factors.extend(divisor);
        // Each number with its sign, or as one of two factors.
        let grouped = |inside: Rich| {
            if terms.len() > 1 && by.is_some() { Rich::upright("(").then(&inside).up(")") } else { inside }
        };
        let joined = |mut each: Box<dyn FnMut(&MomentTerm) -> Rich + '_>, over: Option<Rich>| {
            let mut all = Rich::default();
            for (i, term) in terms.iter().enumerate() {
                let sign = match (i, against(term)) {
                    (0, false) => "",
                    (0, true) => "−",
                    (_, false) => " + ",
                    (_, true) => " − ",
                };
                all = all.up(sign).then(&each(term));
            }
            match over {
                Some(over) => grouped(all).up(OVER).then(&over),
                None => all,
            }
        };
        let named = |term: &MomentTerm| {
            let force = self.name_of(term.of);
            term.arm.map_or(force.clone(), |arm| force.up(DOT).then(&arm_name(self.sheet, &arm, self.n)))
        };
        let names = joined(Box::new(named), by.clone());
        let set = |numbers: &[Rich]| {
            let mut left = numbers.iter();
            let mut next = || left.next().cloned().unwrap_or_default();
            let over = by.is_some().then(|| numbers.last().cloned().unwrap_or_default());
            let each = |term: &MomentTerm| {
                let own = next();
                if term.arm.is_some() { own.up(TIMES).then(&next()) } else { own }
            };
            joined(Box::new(each), over)
        };
        let reckon = |numbers: &[f64]| {
            let mut left = numbers.iter();
            let mut next = || left.next().copied().unwrap_or(1.0);
            let mut total = 0.0;
            for term in &terms {
                let own = next() * if term.arm.is_some() { next() } else { 1.0 };
                total += if against(term) { -own } else { own };
            }
            total / next()
        };
        // Of units that go together the numbers are those of one unit each, whatever their signs.
        let per = units.force.si * units.length.si;
        let together =
            (units.torque.si / per - 1.0).abs() < 1e-9 || terms.iter().all(|term| term.arm.is_some());
        let (own, told) = (format!("{}*{}", units.force.symbol, units.length.symbol), result.unit);
        let own = Unit { symbol: own, si: per };
        let products = by.is_none() && (units.torque.si / per - 1.0).abs() >= 1e-9;
        let unit = if together && products { &own } else { told };
        self.line_in(together, of, names, &factors, set, reckon, (Factor { unit, ..result }, told))
    }

    pub(super) fn key_of_arm(&self, arm: &Arm) -> Key {
        match (arm.between, asked(self.sheet, arm)) {
            (Some([p, q]), _) => Key::length([p, q]),
            (None, Some(own)) => Key::Of(Quantity::Force(own, Share::Total)),
            (None, None) => Key::Arm(numbered(self.sheet, arm).unwrap_or(0)),
        }
    }

    /// An arm as it is printed everywhere.
    fn arm(&self, arm: &Arm) -> Rich {
        let unit = &self.n.scene.units.length;
        human::with_unit(
            &self.figures.borrow_mut().tell(self.key_of_arm(arm), arm.length, unit),
            &unit.symbol,
        )
    }

    /// Whether an arm is a dimension that the scene states.
    pub(super) fn is_told(&self, arm: &Arm) -> bool {
        arm.between.is_some_and(|ends| self.is_stated(ends) || self.is_radius(ends))
    }

    /// Whether it is the radius of a wheel, from its centre to a contact.
    fn is_radius(&self, ends: [PointId; 2]) -> bool {
        let m = self.n.mechanism();
        m.rolls.iter().zip(&m.contacts).any(|(roll, contact)| {
            let centres = match roll {
                Roll::Circles { centres, .. } => centres.to_vec(),
                Roll::Line { centre, .. } => vec![*centre],
            };
            ends.contains(contact) && centres.iter().any(|centre| ends.contains(centre))
        })
    }

    /// Whether the distance of two points is a dimension that the scene states.
    fn is_stated(&self, [a, b]: [crate::mechanism::PointId; 2]) -> bool {
        let mechanism = self.n.mechanism();
        mechanism.moving().any(|link| {
            let stated = super::given::dimensions(mechanism.link(link), self.n);
            stated.iter().any(|own| [[own.from, own.to], [own.to, own.from]].contains(&[a, b]))
        })
    }

    /// What the polygon of a body gives.
    fn polygon(&self, index: usize) -> Vec<Rich> {
        let body = &self.sheet.bodies[index];
        // Two forces of which neither is found, on lines that are not one, are none.
        let zero = |acting: &Acting| acting.closes && acting.force == [0.0; 2];
        if let ([one, other], true) = (&body.acting[..], body.acting.iter().all(zero)) {
            return [one, other].map(|acting| self.short(acting)).to_vec();
        }
        // Two forces are one line there and back.
        if body.acting.len() < 3 || super::governor::without_polygon(self.sheet, index) {
            return Vec::new();
        }
        let words = self.n.words;
        let mut lines = Vec::new();
        let sized = |acting: &&Acting| libm::hypot(acting.force[0], acting.force[1]) > 0.0;
        let all: Vec<&Acting> = body.acting.iter().filter(sized).collect();
        let (found, known): (Vec<&Acting>, Vec<&Acting>) = all.iter().partition(|acting| acting.closes);
        // Where nothing loads the body, nothing holds it.
        if all.is_empty() {
            lines.extend(body.acting.iter().filter(|acting| acting.closes).map(|acting| self.short(acting)));
            return lines;
        }
        let Some(per_mm) = per_mm(self.sheet, ForcePanel::Polygon(index), self.n) else { return lines };
        // Of a force of which moments gave the part across a line that part is laid off, and the line of the rest is open.
        let told = |is: fn(&Turning) -> Option<Action>, of: &Acting| {
            let mut found = self.sheet.moments.iter().filter_map(|moments| is(&moments.found.of));
            found.any(|action| either(action) == either(of.action))
        };
        let across = |of: &Turning| if let Turning::Across(action) = of { Some(*action) } else { None };
        let along = |of: &Turning| if let Turning::Along(action) = of { Some(*action) } else { None };
        let parted = |acting: &Acting| found.len() > 1 && told(across, acting) && !told(along, acting);
        let part = |acting: &Acting, mark: &str| super::force_names::part(self.n, acting.action, mark);
        let panel = ForcePanel::Polygon(index);
        let in_parts = |acting: &Acting| laid_off_in_parts(self.sheet, panel, acting);
        let marks = [self.n.profile.tangential, self.n.profile.normal];
        // Moments gave a part of the force with which the other link acts: this one is that turned round.
        for acting in known.iter().filter(|acting| in_parts(acting).is_some()) {
            lines.extend(self.part_turned_round(acting));
        }
        let beforehand: Vec<Rich> = known
            .iter()
            .flat_map(|acting| match in_parts(acting) {
                Some(_) => marks.iter().map(|mark| part(acting, mark)).collect(),
                None => vec![self.symbol(acting.action)],
            })
            .chain(
                found
                    .iter()
                    .filter(|acting| parted(acting))
                    .map(|acting| part(acting, self.n.profile.tangential)),
            )
            .collect();
        let open: Vec<Rich> = found
            .iter()
            .map(|acting| match parted(acting) {
                true => part(acting, self.n.profile.normal),
                false => self.symbol(acting.action),
            })
            .collect();
        if !beforehand.is_empty() && !found.is_empty() {
            let template = if found.len() > 1 { words.polygon_lines } else { words.polygon_closes };
            let (known, found) = (self.n.list(&beforehand), self.n.list(&open));
            let parts = [("known", known), ("found", found), ("pole", pole(body, self.n))];
            lines.push(Rich::fill(template, &parts));
        }
        for acting in &known {
            let mm = libm::hypot(acting.force[0], acting.force[1]) / per_mm;
            if mm < TOO_SHORT {
                lines.push(self.short(acting));
            }
        }
        // Of what is laid off in two parts the whole is read.
        for acting in known.into_iter().filter(|acting| in_parts(acting).is_some()).chain(found) {
            if in_parts(acting).is_some() {
                let parts = marks.map(|mark| part(acting, mark));
                let sum = Rich::join(&parts, &Rich::upright(" + "));
                lines.push(self.symbol(acting.action).up(EQUALS).then(&sum).up("."));
            }
            lines.push(self.read(acting, per_mm));
        }
        lines
    }

    /// A part of a force that moments gave as that of its reaction.
    fn part_turned_round(&self, acting: &Acting) -> Vec<Rich> {
        let all = self.sheet.moments.iter().filter_map(|moments| match moments.found.of {
            Turning::Across(of) => Some((of, self.n.profile.tangential)),
            Turning::Along(of) => Some((of, self.n.profile.normal)),
            _ => None,
        });
        let turned = all.filter(|(of, _)| either(*of) == either(acting.action) && *of != acting.action);
        let named = |action: Action, mark: &str| super::force_names::part(self.n, action, mark);
        turned
            .map(|(of, mark)| named(acting.action, mark).up(EQUALS).up("−").then(&named(of, mark)).up("."))
            .collect()
    }

    fn short(&self, acting: &Acting) -> Rich {
        if acting.force == [0.0; 2] {
            return Rich::fill(self.n.words.force_is_zero, &[("vector", self.symbol(acting.action))]);
        }
        let size = libm::hypot(acting.force[0], acting.force[1]);
        let key = self.whole(Force::Vector(acting.action));
        let unit = &self.n.scene.units.force;
        let size = match self.n.mechanism().halves_of(acting.action) == 1.0 {
            true => human::with_unit(&self.figures.borrow_mut().tell(key, size, unit), &unit.symbol),
            false => self.force(size),
        };
        Rich::fill(self.n.words.force_as_point, &[("vector", self.symbol(acting.action)), ("value", size)])
    }

    /// How far from a point the line of a force lies of which moments of a body have given the moment about it: a block that
    /// does not turn is held by its guide beside its pin. Where that is asked, it is told with what is asked. Of a force that
    /// is none, that it is a couple.
    fn displaced(&self, moments: &MomentBalance, index: usize) -> Option<Rich> {
        let units = &self.n.scene.units;
        let Turning::Torque(of @ Force::Moment(action, about)) = moments.found.of else { return None };
        let is_asked = self.sheet.arms.iter().any(|own| {
            matches!(own.found.of, Turning::Torque(Force::Arm(other, at) | Force::Moment(other, at))
                if at == about && either(other) == either(action))
        });
        // Unless other moments have an arm to it.
        let uses = |term: &MomentTerm| matches!(term.of, Turning::Force(of) if either(of) == either(action));
        let others = self.sheet.moments.iter().filter(|other| !std::ptr::eq(*other, moments));
        let is_used = others.flat_map(|other| &other.terms).any(uses);
        let is_asked = is_asked && !is_used;
        let key = self.whole(Force::Vector(action));
        let all = self.sheet.bodies[..=index].iter().flat_map(|body| &body.acting);
        let acting = all.into_iter().find(|acting| either(acting.action) == either(action))?;
        if acting.couple != 0.0 {
            let size = {
                let value = moments.found.moment.abs();
                let number = self.figures.borrow_mut().tell(self.whole(of), value, &units.torque);
                human::with_unit(&number, &units.torque.symbol)
            };
            let moment = size.word(self.n.sense(moments.found.moment));
            let parts = [("force", self.symbol(action)), ("moment", moment)];
            return Some(Rich::fill(self.n.words.couple_passed, &parts));
        }
        let size = libm::hypot(acting.force[0], acting.force[1]);
        let moment: f64 = moments.terms.iter().map(|term| term.moment).sum();
        // Beside a point of contact it is told no distance.
        let at_point = matches!(moments.about, About::Point(_));
        if is_asked || !at_point || size == 0.0 || moment == 0.0 || !self.figures.borrow().has(key) {
            return None;
        }
        let factors = [
            Factor::new(moment.abs(), &units.torque, "N·m").of(self.whole(of)),
            Factor::new(size, &units.force, "N").of(key),
        ];
        let symbol = |force: Force| self.n.symbol(Quantity::Force(force, Share::Total), false);
        let result = Factor::new(moment.abs() / size, &units.length, "m");
        let formula = symbol(of).up(OVER).then(&self.symbol(action));
        let named = symbol(Force::Arm(action, about));
        let equation = self.line(named, formula, &factors, quotient, |n| n[0] / n[1], result);
        let parts = [("force", self.symbol(action)), ("point", self.n.point(about)), ("equation", equation)];
        Some(Rich::fill(self.n.words.line_beside, &parts))
    }

    /// A force on a body of which moments have given both parts: it is laid off as what these make together.
    fn of_both_parts(&self, index: usize) -> Vec<Rich> {
        let unit = &self.n.scene.units.force;
        let body = &self.sheet.bodies[index];
        let size_of = |key: Key| {
            let mut told = self.sheet.moments.iter().filter(|moments| moments.told <= index);
            told.find(|moments| self.key_of(moments.found.of) == key).map(|moments| {
                let sum: f64 = moments.terms.iter().map(|term| term.moment).sum();
                sum.abs() / moments.found.arm.map_or(1.0, |arm| arm.length)
            })
        };
        // Of two forces there is no polygon in which the parts would be laid off.
        let in_parts = |acting: &Acting| acting.parts.is_some() && body.acting.len() > 2;
        let own = body.acting.iter().filter(|acting| !acting.closes && !in_parts(acting));
        let told = own.filter_map(|acting| {
            let keys = [self.part_key(acting.action), Key::Part(either(acting.action), false)];
            let [across, along] = [size_of(keys[0])?, size_of(keys[1])?];
            let whole = self.whole(Force::Vector(acting.action));
            if self.figures.borrow().has(whole) {
                return None;
            }
            let root = |first: Rich, second: Rich| {
                Rich::upright("√(").then(&squared(&first)).up(" + ").then(&squared(&second)).up(")")
            };
            let part = |mark: &str| {
                let name = super::force_names::part(self.n, acting.action, mark);
                Rich::upright("(").then(&name).up(")²")
            };
            let [tangential, normal] = [self.n.profile.tangential, self.n.profile.normal].map(part);
            let formula = Rich::upright("√(").then(&tangential).up(" + ").then(&normal).up(")");
            let factors =
                [Factor::new(across, unit, "N").of(keys[0]), Factor::new(along, unit, "N").of(keys[1])];
            let [x, y] = acting.force;
            let result = Factor::new(libm::hypot(x, y), unit, "N").of(whole);
            let set = |n: &[Rich]| root(n[0].clone(), n[1].clone());
            let reckon = |n: &[f64]| libm::hypot(n[0], n[1]);
            let own = self.symbol(acting.action);
            let line = self.line_in(true, own, formula, &factors, set, reckon, (result, unit));
            let angle = Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(y, x)));
            Some(line.up(self.n.words.comma).then(&angle).up("."))
        });
        told.collect()
    }

    /// The parts of a force along and across a line that are asked and that no moments have given: it is split in the first
    /// polygon in which it stands.
    fn split(&self, index: usize) -> Vec<Rich> {
        let m = self.n.mechanism();
        let stands = |body: &FreeBody, action: Action| {
            body.acting.iter().any(|acting| either(acting.action) == either(action))
        };
        let panel = |index: usize| ForcePanel::Polygon(index);
        let panels = ForcePanel::all(self.sheet);
        let Some(per_mm) = per_mm(self.sheet, panel(index), self.n) else { return Vec::new() };
        let mut lines = Vec::new();
        let mut split: Vec<(Action, PointId)> = Vec::new();
        for (asked, reading) in m.asked.iter().zip(&self.construction.answers) {
            let (Quantity::Force(force, Share::Total), Answer::Vector { value, .. }) =
                (asked.quantity, &reading.answer)
            else {
                continue;
            };
            let (Force::Along { by, on, from } | Force::Across { by, on, from }) = force else { continue };
            let action = Action::Pair { by, on };
            let given = self.sheet.moments.iter().any(|moments| match (force, moments.found.of) {
                (Force::Along { .. }, Turning::Along(of)) | (Force::Across { .. }, Turning::Across(of)) => {
                    either(of) == either(action)
                }
                _ => false,
            });
            let first = (0..self.sheet.bodies.len())
                .find(|k| stands(&self.sheet.bodies[*k], action) && panels.contains(&panel(*k)));
            let Some(pin) = m.meeting_point(by, on).filter(|_| !given && first == Some(index)) else {
                continue;
            };
            if !split.contains(&(action, from)) {
                split.push((action, from));
                let parts = [("force", self.symbol(action)), ("line", self.n.length(from, pin))];
                lines.push(Rich::fill(self.n.words.split_force, &parts));
            }
            let key = Key::of(asked.quantity, self.n);
            lines.push(self.read_as(self.n.symbol(asked.quantity, false), key, *value, per_mm));
        }
        lines
    }

    fn read(&self, acting: &Acting, per_mm: f64) -> Rich {
        let key = self.whole(Force::Vector(acting.action));
        self.read_as(self.symbol(acting.action), key, acting.force, per_mm)
    }

    /// A force, or a part of one, as it is read off a polygon.
    fn read_as(&self, vector: Rich, key: Key, [x, y]: [f64; 2], per_mm: f64) -> Rich {
        let size = libm::hypot(x, y);
        let mm = size / per_mm;
        if size == 0.0 {
            return Rich::fill(self.n.words.force_is_zero, &[("vector", vector)]);
        }
        if mm < TOO_SHORT {
            let parts = [("vector", vector), ("value", self.force(size))];
            return Rich::fill(self.n.words.too_short, &parts);
        }
        let unit = &self.n.scene.units.force;
        let factor = per_mm / unit.si;
        let mut figures = self.figures.borrow_mut();
        // What another line has told is read as it stands there.
        let own = figures.print_of(key).filter(|print| print.unit == *unit).map(Print::si);
        let read = own.unwrap_or(size) / unit.si;
        let more = figures.more(key);
        let (reading, amount, written) = match figures.guards() {
            true => figures.read_off(key, mm, factor, read, more),
            false => human::reading_at(mm, factor, read, more),
        };
        figures.note(key, &amount, (written, size / unit.si), unit);
        let reading = reading
            .up(TIMES)
            .then(&human::with_unit(&human::stated(factor), &unit.symbol))
            .up(EQUALS)
            .then(&human::with_unit(&amount, &unit.symbol));
        let angle = Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(y, x)));
        let parts = [("vector", vector), ("reading", reading), ("angle", angle)];
        Rich::fill(self.n.words.read_force, &parts)
    }

    /// The polygon of everything from outside, with its gap.
    fn whole_told(&self) -> Vec<Item> {
        if self.sheet.whole.len() < 3 || super::forces::whole_repeats(self.sheet) {
            return Vec::new();
        }
        let Some(per_mm) = per_mm(self.sheet, ForcePanel::Whole, self.n) else { return Vec::new() };
        let words = self.n.words;
        let gap = self
            .sheet
            .whole
            .iter()
            .fold([0.0; 2], |sum: [f64; 2], acting| [sum[0] + acting.force[0], sum[1] + acting.force[1]]);
        let mm = libm::hypot(gap[0], gap[1]) / per_mm;
        let terms: Vec<Rich> = self.sheet.whole.iter().map(|acting| self.symbol(acting.action)).collect();
        let sum = Rich::join(&terms, &Rich::upright(" + ")).up("\u{a0}= 0");
        let parts = [("equation", sum), ("gap", human::millimetres(mm))];
        vec![
            self.head(Rich::upright(words.step_outer)),
            Item::Sentence(Rich::fill(words.outer_close, &parts)),
        ]
    }

    /// The shaking force, and its line by moments about the first fixed pivot.
    fn shaking(&self) -> Vec<Item> {
        let Some(shaking) = self.sheet.shaking.as_ref().filter(|_| self.sheet.asks_shaking) else {
            return Vec::new();
        };
        let head = self.head(Rich::upright(self.n.words.shaking_figure));
        let sum = self.sum(Action::Shaking, &self.sheet.inertia, ForcePanel::Shaking);
        let line = self.line_of_sum(Action::Shaking, &self.sheet.inertia, shaking);
        [head].into_iter().chain(sum).chain(line.into_iter().map(Item::Sentence)).collect()
    }

    /// What the frame feels: the sum of what its pairs pass on, and its line.
    fn on_frame(&self) -> Vec<Item> {
        if self.sheet.frame.is_empty() {
            return Vec::new();
        }
        let head = self.head(Rich::upright(self.n.words.frame_figure));
        let sum = self.sum(Action::OnFrame, &self.sheet.frame, ForcePanel::Frame);
        let line = self.sheet.frame_line.iter();
        let line = line.flat_map(|line| self.line_of_sum(Action::OnFrame, &self.sheet.frame, line));
        [head].into_iter().chain(sum).chain(line.map(Item::Sentence)).collect()
    }

    /// A force as the sum of others, read off their polygon.
    fn sum(&self, action: Action, forces: &[Acting], panel: ForcePanel) -> Vec<Item> {
        let words = self.n.words;
        let mut items = Vec::new();
        if let [only] = forces {
            // One force is its own sum, and stands as it was told.
            let unit = &self.n.scene.units.force;
            let [of, is] = [action, only.action].map(|action| self.whole(Force::Vector(action)));
            let number = {
                let mut figures = self.figures.borrow_mut();
                let number = figures.tell(is, libm::hypot(only.force[0], only.force[1]), unit);
                figures.alias(of, is);
                human::with_unit(&number, &unit.symbol)
            };
            let angle =
                Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(only.force[1], only.force[0])));
            let equal = self.symbol(action).up(EQUALS).then(&self.symbol(only.action));
            let told = equal.up(words.semicolon).then(&number).up(words.comma).then(&angle).up(".");
            items.push(Item::Sentence(told));
            return items;
        }
        let terms: Vec<Rich> = forces.iter().map(|acting| self.symbol(acting.action)).collect();
        let sum = forces.iter().fold([0.0; 2], |sum: [f64; 2], a| [sum[0] + a.force[0], sum[1] + a.force[1]]);
        let symbol = self.symbol(action);
        if terms.len() > 1 {
            let equation = symbol.up(EQUALS).then(&Rich::join(&terms, &Rich::upright(" + "))).up(".");
            items.push(Item::Sentence(equation));
        }
        if let Some(per_mm) = per_mm(self.sheet, panel, self.n) {
            let acting = Acting {
                action,
                at: [0.0; 2],
                through: [0.0; 2],
                force: sum,
                known: Knowledge::Full,
                closes: true,
                with_couple: false,
                parts: None,
                couple: 0.0,
            };
            items.push(Item::Sentence(self.read(&acting, per_mm)));
        }
        items
    }

    /// Arms and moments that are asked: measured, or those of a balance.
    fn asked_arms(&self) -> Vec<Item> {
        let units = &self.n.scene.units;
        let mut items = vec![self.head(Rich::upright(self.n.words.arms_figure))];
        let mut couples: Vec<Action> = Vec::new();
        let mut told: Vec<(Action, PointId)> = Vec::new();
        for own in &self.sheet.arms {
            let Turning::Torque(of @ (Force::Arm(action, about) | Force::Moment(action, about))) =
                own.found.of
            else {
                continue;
            };
            if own.found.arm.is_none() && own.found.moment != 0.0 {
                // Moments of a body have told its couple, or it is told here for all points.
                let is_told = self.sheet.moments.iter().any(|moments| match moments.found.of {
                    Turning::Torque(Force::Moment(other, _)) => either(other) == either(action),
                    _ => false,
                });
                if !is_told && !couples.contains(&action) {
                    couples.push(action);
                    let parts = [("force", self.symbol(action)), ("moment", self.torque(own.found.moment))];
                    items.push(Item::Sentence(Rich::fill(self.n.words.couple_left, &parts)));
                }
                continue;
            }
            let Some(arm) = own.found.arm else {
                let named = self.n.symbol(Quantity::Force(of, Share::Total), false);
                let equation = named.up(EQUALS).up("0");
                let parts =
                    [("force", self.symbol(action)), ("point", self.n.point(about)), ("equation", equation)];
                items.push(Item::Sentence(Rich::fill(self.n.words.passes_through, &parts)));
                continue;
            };
            if super::forces::is_a_couple(&arm, self.construction) {
                // The line of what is but rounding lies anywhere.
                if couples.contains(&action) {
                    continue;
                }
                couples.push(action);
                let parts = [("force", self.symbol(action)), ("moment", self.torque(own.found.moment))];
                items.push(Item::Sentence(Rich::fill(self.n.words.couple_left, &parts)));
                continue;
            }
            let symbol = |force: Force| self.n.symbol(Quantity::Force(force, Share::Total), false);
            let named = symbol(Force::Arm(action, about));
            let key = self.key_of_arm(&arm);
            if self.has_moment(action, about) {
                // Its line stands where its moment puts it.
                if matches!(of, Force::Arm(..)) && !told.contains(&(action, about)) {
                    told.push((action, about));
                    let moment = Force::Moment(action, about);
                    let factors = [
                        Factor::new(own.found.moment.abs(), &units.torque, "N·m").of(self.whole(moment)),
                        Factor::new(own.found.size, &units.force, "N").of(self.whole(Force::Vector(action))),
                    ];
                    let result = Factor::new(arm.length, &units.length, "m").of(self.whole(of));
                    let formula = symbol(moment).up(OVER).then(&self.symbol(action));
                    let line = self.line(named, formula, &factors, quotient, |n| n[0] / n[1], result);
                    items.push(Item::Sentence(line));
                }
                continue;
            }
            let line = if own.told == 0 && arm.between.is_none() {
                let mm = arm.length / self.construction.space.metres_per_mm;
                let (reading, length) = self.measured(key, arm.length, mm);
                let told = as_measured(named, &reading, &length);
                Rich::fill(self.n.words.measured_arms, &[("list", told)])
            } else {
                // A balance has it by another name.
                let told = arm_name(self.sheet, &arm, self.n);
                self.figures
                    .borrow_mut()
                    .alias(Key::Of(Quantity::Force(Force::Arm(action, about), Share::Total)), key);
                named.up(EQUALS).then(&told).up(EQUALS).then(&self.arm(&arm))
            };
            // An arm is told once, for itself and for its moment.
            if !told.contains(&(action, about)) {
                told.push((action, about));
                items.push(Item::Sentence(line));
            }
            if let Force::Moment(..) = of {
                let factors = [
                    Factor::new(own.found.size, &units.force, "N").of(self.whole(Force::Vector(action))),
                    Factor::new(arm.length, &units.length, "m").of(key),
                ];
                let result = Factor::new(own.found.moment.abs(), &units.torque, "N·m").of(self.whole(of));
                let formula = self.symbol(action).up(DOT).then(&arm_name(self.sheet, &arm, self.n));
                let line = self.line(symbol(of), formula, &factors, product, |n| n[0] * n[1], result);
                items.push(Item::Sentence(line.word(self.n.sense(own.found.moment))));
            }
        }
        items
    }

    /// Whether moments of its body have told the moment of this force about this point.
    fn has_moment(&self, action: Action, about: PointId) -> bool {
        let moment = Turning::Torque(Force::Moment(action, about));
        self.sheet.moments.iter().any(|moments| moments.found.of == moment)
    }

    /// Stiffnesses that were sought: what the spring exerts over how much it is longer, or further turned, than without load.
    fn stiffnesses(&self) -> Vec<Item> {
        let (words, units) = (self.n.words, &self.n.scene.units);
        let mut items = vec![self.head(Rich::upright(words.step_stiffness))];
        // The lines of a governor tell it.
        for of in self.sheet.stiffnesses.iter().filter(|_| self.sheet.governor.is_none()) {
            let spring = &self.n.mechanism().forces.springs[of.spring];
            let pulls = matches!(spring.kind, SpringKind::Pull(_));
            let force = if pulls { Force::Pull(of.spring) } else { Force::Twist(of.spring) };
            let radian = Unit { symbol: "rad".to_owned(), si: 1.0 };
            let per_radian = Unit { symbol: "N*m/rad".to_owned(), si: 1.0 };
            let SpringLaw::Stiffness { free, .. } = spring.law else { continue };
            let now = free.value + of.longer;
            // A spring pulls where it is longer than without load, a torsion spring turns back.
            let (exerted, ends) = match pulls {
                true => (of.value * of.longer, [now, free.value]),
                false => (-of.value * of.longer, [free.value, now]),
            };
            let (force_unit, force_name) = if pulls { (&units.force, "N") } else { (&units.torque, "N·m") };
            let (size_unit, size_name) = if pulls { (&units.length, "m") } else { (&radian, "rad") };
            let result = match pulls {
                true => Factor::new(of.value, &units.stiffness, "N/m"),
                false => Factor::new(of.value, &per_radian, "N·m/rad"),
            };
            let factors = [
                Factor::new(exerted.abs(), force_unit, force_name).of(self.whole(force)),
                Factor::new(ends[0], size_unit, size_name),
                Factor::new(ends[1], size_unit, size_name),
            ];
            let symbol = self.n.symbol(Quantity::Force(force, self.share), false);
            let names = match (pulls, spring.kind) {
                (true, SpringKind::Pull([(_, from), (_, to)])) => {
                    [self.n.length(from, to), Rich::italic("l").sub(&spring.name)]
                }
                _ => [Rich::italic("φ").sub(&spring.name), Rich::italic("φ")],
            };
            if let (SpringKind::Pull([(_, from), (_, to)]), [now, _]) = (spring.kind, ends) {
                let metres_per_mm = self.construction.space.metres_per_mm;
                let told = [human::millimetres(now / metres_per_mm), self.length(now)];
                let measured =
                    super::steps::measured_length(self.n.length(from, to), told, metres_per_mm, self.n);
                items.push(Item::Sentence(measured));
            }
            let [first, second] = names;
            let formula = symbol.up(OVER).up("(").then(&first).up(" − ").then(&second).up(")");
            let back = exerted < 0.0;
            let set = |n: &[Rich]| {
                let exerted = if back { Rich::upright("−").then(&n[0]) } else { n[0].clone() };
                exerted.up(OVER).up("(").then(&n[1]).up(" − ").then(&n[2]).up(")")
            };
            let reckon = |n: &[f64]| (if back { -n[0] } else { n[0] }) / (n[1] - n[2]);
            let name = Rich::italic("K").sub(&spring.name);
            let line = self.line(name, formula, &factors, set, reckon, result);
            items.push(Item::Sentence(match of.value < 0.0 {
                true => line.aside(words.comma, &Rich::upright(words.stiffness_negative)),
                false => line,
            }));
        }
        items
    }

    /// What loads alone and inertia alone come to, where that is asked: the drawing without the one and without the other.
    fn shares(&self) -> Vec<Item> {
        let words = self.n.words;
        let mut items = vec![self.head(Rich::upright(words.step_shares))];
        let asked = || self.n.mechanism().asked.iter().zip(&self.construction.answers);
        for (share, template) in [(Share::Static, words.share_static), (Share::Inertia, words.share_inertia)]
        {
            let told = asked().filter_map(|(asked, reading)| match (asked.quantity, &reading.answer) {
                (Quantity::Force(force, own), Answer::Scalar { value, .. }) if own == share => {
                    let size = match force.turns() {
                        true => self.n.with_sense(human::quantity(value.abs(), &asked.unit), *value),
                        false => human::quantity(*value, &asked.unit),
                    };
                    Some(self.n.symbol(asked.quantity, false).up(EQUALS).then(&size))
                }
                (Quantity::Force(_, own), Answer::Vector { value: [x, y], bound }) if own == share => {
                    let size = libm::hypot(*x, *y);
                    let told = human::quantity(if size <= *bound { 0.0 } else { size }, &asked.unit);
                    let told = self.n.symbol(asked.quantity, false).up(EQUALS).then(&told);
                    let angle = Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(*y, *x)));
                    Some(if size <= *bound { told } else { told.up("\u{a0}").then(&angle) })
                }
                _ => None,
            });
            let told: Vec<Rich> = told.collect();
            if !told.is_empty() && share != self.sheet.share {
                items.push(Item::Sentence(Rich::fill(template, &[("list", self.n.list(&told))])));
            }
        }
        items
    }

    /// e = ΣF·arm / F_S, of the shaking force or another sum.
    fn line_of_sum(&self, action: Action, forces: &[Acting], line: &MomentBalance) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let words = self.n.words;
        let Some(arm) = line.found.arm else { return Vec::new() };
        let sum: f64 = line.terms.iter().map(|term| term.moment).sum();
        // One force without a couple is its own sum, and so is its line.
        if line.terms.is_empty() || (forces.len() < 2 && line.terms.len() < 2) || sum == 0.0 {
            return Vec::new();
        }
        let mut lines = Vec::new();
        let measured = self.arms_of(&MomentBalance { found: line.terms[0], ..line.clone() });
        if !measured.is_empty() {
            let list = Rich::join(&measured, &Rich::upright(words.comma));
            lines.push(Rich::fill(words.measured_arms, &[("list", list)]));
        }
        let force = self.whole(Force::Vector(action));
        let size = Factor::new(line.found.size, &units.force, "N").of(force);
        let result = Factor::new(sum.abs() / line.found.size, &units.length, "m").of(self.key_of_arm(&arm));
        let name = arm_name(self.sheet, &arm, self.n);
        let divisor = Some((self.symbol(action), size));
        let equation = self.weighed(name, &line.terms, divisor, result);
        let About::Point(about) = line.about else { return Vec::new() };
        let parts = [("point", self.n.point(about)), ("equation", equation)];
        lines.push(Rich::fill(words.shaking_line, &parts));
        lines
    }
}

/// A length as it is measured on paper and what it stands for, in one line; once where both are one.
pub(super) fn as_measured(name: Rich, reading: &Rich, length: &Rich) -> Rich {
    let told = name.up("\u{a0}=\u{a0}").then(reading);
    match reading.plain() == length.plain() {
        true => told,
        false => told.up("\u{a0}≙\u{a0}").then(length),
    }
}

/// The square of a number; with its unit it stands in brackets.
fn squared(number: &Rich) -> Rich {
    match number.plain().contains(char::is_alphabetic) {
        true => Rich::upright("(").then(number).up(")²"),
        false => number.clone().up("²"),
    }
}

pub(super) fn product(numbers: &[Rich]) -> Rich {
    Rich::join(numbers, &Rich::upright(TIMES))
}

fn quotient(numbers: &[Rich]) -> Rich {
    Rich::join(numbers, &Rich::upright(OVER))
}

/// The radius of the circle that a force touches; none of what is no circle.
fn touch_radius(by: RubbedBy) -> f64 {
    match by {
        RubbedBy::Circle(radius) => radius,
        RubbedBy::Angle(_) | RubbedBy::Drag(_) => 0.0,
    }
}
