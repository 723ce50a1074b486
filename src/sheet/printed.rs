//! How each number is printed on a sheet, and what its lines need to close from their own printed numbers.

use std::collections::{HashMap, HashSet};
use std::hash::Hash;

use super::human;
use super::notation::Notation;
use super::rich::Rich;
use crate::graphical::construction::Spot;
use crate::mechanism::force::{Action, Force};
use crate::mechanism::quantity::{DiagramKind, Method, Quantity, Unit};
use crate::mechanism::{Input, LinkId, PointId};

/// What a number is of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Key {
    /// The magnitude of a quantity.
    Of(Quantity),
    /// Of a point of a link against another point of it: its quantity names the first only.
    From(Quantity, PointId),
    /// The distance of two points on the skeleton, the first of lower number.
    Length([PointId; 2]),
    /// The velocity of the common centre of two links.
    AtCentre([LinkId; 2]),
    /// The distance of a point or centre from a pole.
    Radius([LinkId; 2], Spot),
    /// The part of a force along the line of a link, or across it.
    Part(Action, Across),
    /// An arm of a force by its number on the sheet.
    Arm(usize),
    /// What a letter says of a link: its mass, weight, moment of inertia.
    OfLink(&'static str, LinkId),
    /// What a letter says of the whole: the period, the speed of a diagram without links.
    Given(&'static str),
    /// The area on which the pressure of a load acts, by the load's index.
    Area(usize),
    /// The power of a force or a torque, its moment on a lever.
    Power(Force),
}

/// Whether a part of a force is that across the line of a link.
pub type Across = bool;

impl Key {
    pub(super) fn of(quantity: Quantity, notation: &Notation<'_>) -> Self {
        Self::Of(absolute(quantity, notation))
    }

    /// The same of a vector that begins at the image of a point.
    pub(super) fn from(quantity: Quantity, reference: Option<PointId>, notation: &Notation<'_>) -> Self {
        let names_one = matches!(
            quantity,
            Quantity::CoincidentVelocity(..)
                | Quantity::CoincidentAcceleration(..)
                | Quantity::CoincidentNormal(..)
                | Quantity::CoincidentTangential(..)
        );
        match reference.filter(|point| names_one && !notation.mechanism().is_fixed(*point)) {
            Some(point) => Self::From(quantity, point),
            None => Self::of(quantity, notation),
        }
    }

    pub(super) fn length([p, q]: [PointId; 2]) -> Self {
        Self::Length([p.min(q), p.max(q)])
    }
}

/// How each number is printed in the steps, wherever it stands there: as it was told first.
#[derive(Debug, Clone, Default)]
pub struct Figures {
    printed: HashMap<Key, Print>,
    /// What a line tells in a second unit besides.
    also: HashMap<Key, Print>,
    /// What has so many figures more than usual, because a line that uses it needs them.
    finer: HashMap<Key, usize>,
    /// What lines would have needed so many for.
    wanted: HashMap<Key, usize>,
    /// What was read or measured.
    read: HashSet<Key>,
    /// Readings that are told as the other of the two numbers of four figures between which they lie, because a line would
    /// not give the third figure of its result by the nearer one; and those that lines would have needed so.
    beside: HashSet<Key>,
    wanted_beside: HashSet<Key>,
    /// What carries a figure as a guard, because a result that follows from it would else be rounded otherwise than it is;
    /// and that from which such numbers follow.
    guarded: HashSet<Key>,
    wanted_guards: HashSet<Key>,
    /// What was read off polygons, mm.
    readings: Vec<(DiagramKind, f64, Key)>,
    /// The same two of constructions on the skeleton, each by its number on the sheet.
    finer_apart: HashMap<(Apart, Key), usize>,
    wanted_apart: HashMap<(Apart, Key), usize>,
    /// What velocities carried over come to, by the method that was asked for.
    carried_over: HashMap<(Method, Key), Print>,
}

/// A construction on the skeleton that has readings of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Apart {
    /// A velocity carried over by instant centres, by the number of its method on the sheet.
    Transfer(usize),
    /// Another construction by its title's number on the sheet.
    Auxiliary(usize),
}

/// A number as it is printed.
#[derive(Debug, Clone)]
pub(super) struct Print {
    pub(super) text: Rich,
    /// The number that stands there.
    number: f64,
    /// The number that it stands for, in the same unit.
    exact: f64,
    pub(super) unit: Unit,
}

impl Print {
    /// The number that stands there, SI.
    pub(super) fn si(&self) -> f64 {
        self.number * self.unit.si
    }
}

/// No number has so many figures more than usual that another does not close without.
const MOST_MORE: usize = 2;

/// What a line may do to end in what its printed numbers give.
#[derive(Debug, Clone, Copy)]
struct Room {
    /// By so much of a result what is reckoned from printed numbers may differ from it.
    far: f64,
    /// Figures of a number that stands in no other line.
    figures: usize,
}

impl Room {
    /// Half of the third figure; nobody reads more than four.
    const OF_READINGS: Self = Self { far: 5e-3, figures: 4 };
    /// However far.
    const OF_ALL: Self = Self { far: f64::INFINITY, ..Self::OF_READINGS };
    /// A small difference of what stands above, as long as it has its sign; with a figure as a guard for such differences.
    const OF_SUMS: Self = Self { far: 0.5, figures: 5 };
}

impl Figures {
    /// Begins again with what was wanted.
    pub(super) fn again(&self) -> Self {
        fn with<K: Copy + Eq + Hash>(
            finer: &HashMap<K, usize>,
            wanted: &HashMap<K, usize>,
        ) -> HashMap<K, usize> {
            let mut all = finer.clone();
            for (key, more) in wanted {
                let own = all.entry(*key).or_insert(0);
                *own = (*own).max(*more);
            }
            all
        }
        Self {
            finer: with(&self.finer, &self.wanted),
            finer_apart: with(&self.finer_apart, &self.wanted_apart),
            beside: self.beside.union(&self.wanted_beside).copied().collect(),
            guarded: self.guarded.union(&self.wanted_guards).copied().collect(),
            ..Self::default()
        }
    }

    /// Begins again with a guard for these results.
    pub(super) fn guarding(&self, results: &[Key]) -> Self {
        let mut next = self.again();
        next.guarded.extend(results);
        next
    }

    /// Whether anything carries a guard.
    pub(super) fn guards(&self) -> bool {
        !self.guarded.is_empty()
    }

    /// How the rates of the inputs are printed, and nothing else: what a construction of its own begins with.
    pub(super) fn of_inputs(&self, apart: Apart, notation: &Notation<'_>) -> Self {
        let printed = self.printed.iter().filter(|(key, _)| is_driven(**key, notation));
        let of_inputs = self.finer.iter().filter(|(key, _)| is_driven(**key, notation));
        let own = self.finer_apart.iter().filter(|((of, _), _)| *of == apart);
        let finer =
            of_inputs.map(|(key, more)| (*key, *more)).chain(own.map(|((_, key), more)| (*key, *more)));
        Self {
            printed: printed.map(|(key, print)| (*key, print.clone())).collect(),
            finer: finer.collect(),
            ..Self::default()
        }
    }

    /// The same with as many figures as the steps have of velocities that they calculate of points of driven links: nobody reads
    /// these.
    pub(super) fn with_driven_points(mut self, steps: &Self, notation: &Notation<'_>) -> Self {
        let mechanism = notation.mechanism();
        let driven = mechanism.inputs.iter().filter_map(|input| match input {
            Input::Angle { link, .. } | Input::Speed { link, .. } => Some(*link),
            Input::Slide { .. } => None,
        });
        for point in driven.flat_map(|link| &mechanism.link(link).points) {
            let key = Key::of(Quantity::Velocity(*point), notation);
            if let Some(more) = steps.finer.get(&key) {
                self.finer.insert(key, *more);
            }
        }
        self
    }

    /// Keeps of what a construction on the skeleton would have needed more figures.
    pub(super) fn keep_apart(&mut self, apart: Apart, own: &Self, notation: &Notation<'_>) {
        for (key, more) in &own.wanted {
            let wanted = if is_driven(*key, notation) {
                self.wanted.entry(*key).or_insert(0)
            } else {
                self.wanted_apart.entry((apart, *key)).or_insert(0)
            };
            *wanted = (*wanted).max(*more);
        }
    }

    /// Keeps what a velocity or a rate comes to by a method on the skeleton: the table tells it as its line does.
    pub(super) fn keep_result(&mut self, method: Method, key: Key, print: Print) {
        self.carried_over.insert((method, key), print);
    }

    /// Whether everything has the figures that lines need of it.
    pub(super) fn suffice(&self) -> bool {
        let apart =
            |(key, more): (&(Apart, Key), &usize)| self.finer_apart.get(key).is_some_and(|own| own >= more);
        self.wanted.iter().all(|(key, more)| self.more(*key) >= *more)
            && self.wanted_apart.iter().all(apart)
            && self.wanted_beside.is_subset(&self.beside)
            && self.wanted_guards.is_subset(&self.guarded)
    }

    /// How many figures more than usual a number has.
    pub(super) fn more(&self, key: Key) -> usize {
        match self.guarded.contains(&key) {
            true => human::AS_A_GUARD,
            false => self.finer.get(&key).copied().unwrap_or(0),
        }
    }

    pub(super) fn note(&mut self, key: Key, text: &Rich, (number, exact): (f64, f64), unit: &Unit) {
        let print = Print { text: text.clone(), number, exact, unit: unit.clone() };
        self.printed.entry(key).or_insert(print);
    }

    /// The same in a second unit, in which the line that tells a number ends.
    pub(super) fn note_also(&mut self, key: Key, text: &Rich, (number, exact): (f64, f64), unit: &Unit) {
        let print = Print { text: text.clone(), number, exact, unit: unit.clone() };
        self.also.entry(key).or_insert(print);
    }

    /// A magnitude as it is printed in this unit; of what was not told yet as it is told from now on.
    pub(super) fn tell(&mut self, key: Key, si: f64, unit: &Unit) -> Rich {
        self.number(key, si, unit).0
    }

    /// The same with the number that stands there.
    pub(super) fn number(&mut self, key: Key, si: f64, unit: &Unit) -> (Rich, f64) {
        let told = [self.printed.get(&key), self.also.get(&key)];
        if let Some(print) = told.into_iter().flatten().find(|print| print.unit == *unit) {
            return (print.text.clone(), print.number);
        }
        // In a unit of which the other is so many tens it has the same figures.
        if let Some(print) = self.printed.get(&key) {
            let ratio = print.unit.si / unit.si;
            let tens = libm::log10(ratio);
            if (tens - libm::round(tens)).abs() < 1e-9 {
                return human::shifted(print.number, libm::round(tens) as i32);
            }
        }
        let (text, number) = human::given(si.abs() / unit.si, self.more(key));
        self.note(key, &text, (number, si.abs() / unit.si), unit);
        (text, number)
    }

    /// The reading of so many millimetres, what it is by the scale, and the number that then stands there.
    pub(super) fn read_off(
        &mut self,
        key: Key,
        mm: f64,
        factor: f64,
        result: f64,
        more: usize,
    ) -> (Rich, Rich, f64) {
        self.read.insert(key);
        let beside = self.beside.contains(&key).then(|| human::reading_beside(mm, factor, result, more));
        beside.flatten().unwrap_or_else(|| human::reading_at(mm, factor, result, more))
    }

    /// Asks for the other neighbour of a reading where four figures of it do not give the third figure of a result and the
    /// other one does.
    fn want_beside(
        &mut self,
        factors: &[(Option<Key>, f64, &Unit)],
        printed: &[f64],
        (reckoned, exact): (f64, f64),
        reckon: impl Fn(&[f64]) -> f64,
    ) {
        let third = |value: f64| format!("{value:.2e}");
        if third(reckoned) == third(exact) {
            return;
        }
        for (index, (key, si, unit)) in factors.iter().enumerate() {
            let Some(key) = key.filter(|key| self.read.contains(key) && !self.beside.contains(key)) else {
                continue;
            };
            let (own, figures) =
                (si.abs() / unit.si, human::figures_of_reading(si / unit.si, self.more(key)));
            let mut others = printed.to_vec();
            others[index] = human::other_neighbour(printed[index], own, figures);
            if figures > 3 && third(reckon(&others)) == third(exact) {
                self.wanted_beside.insert(key);
                return;
            }
        }
    }

    /// How many figures more than usual a reading has: lengths that are one on paper are read alike, whatever they are of.
    pub(super) fn more_of_reading(&mut self, key: Key, kind: DiagramKind, mm: f64) -> usize {
        let same = |(of, own, _): &&(DiagramKind, f64, Key)| *of == kind && (own - mm).abs() <= 1e-9 * mm;
        let Some((.., first)) = self.readings.iter().find(same).copied() else {
            self.readings.push((kind, mm, key));
            return self.more(key);
        };
        let more = self.more(key).max(self.more(first));
        for own in [key, first] {
            let wanted = self.wanted.entry(own).or_insert(0);
            *wanted = (*wanted).max(more);
        }
        // Nor has one of them the other neighbour of four figures.
        if [key, first].iter().any(|own| self.beside.contains(own)) {
            self.wanted_beside.extend([key, first]);
        }
        more
    }

    /// A magnitude that stands there already under whatever name.
    pub(super) fn same(&self, si: f64, unit: &Unit) -> Option<Rich> {
        let own = si.abs() / unit.si;
        let alike = |print: &&Print| print.unit == *unit && (print.exact - own).abs() <= 1e-9 * own;
        let all = self.printed.values().filter(alike);
        all.min_by(|a, b| a.number.total_cmp(&b.number)).map(|print| print.text.clone())
    }

    /// Asks for one more figure of a number.
    pub(super) fn want(&mut self, key: Key) {
        let more = (self.more(key) + 1).min(MOST_MORE);
        let own = self.wanted.entry(key).or_insert(0);
        *own = (*own).max(more);
    }

    /// Asks for one more figure than usual.
    pub(super) fn want_one(&mut self, key: Key) {
        if self.more(key) == 0 {
            self.want(key);
        }
    }

    /// Asks for one more figure of what is laid off, where as it is printed it is so far off what is drawn, and later read,
    /// that a ruler shows it. Where the line that tells it has not come to it yet, that line asks for more itself.
    pub(super) fn want_on_paper(&mut self, key: Key, si_per_mm: f64) {
        /// Half of a tenth of a millimetre.
        const SEEN: f64 = 0.05;
        let Some(print) = self.printed.get(&key) else { return };
        let is_its_own = human::limited(print.exact, self.more(key)).1 == print.number;
        let off = (print.number - print.exact).abs() * print.unit.si / si_per_mm;
        if is_its_own && off > SEEN {
            self.want(key);
        }
    }

    /// Asks for more figures of a number, unless it stands there to the fifth, in which scales are told.
    pub(super) fn want_for_scale(&mut self, key: Key) {
        /// Half a unit of a fifth figure.
        const ROUNDED: f64 = 5e-5;
        if self.printed.get(&key).is_some_and(|print| (print.number / print.exact - 1.0).abs() > ROUNDED) {
            self.want(key);
        }
    }

    /// A number that is another one, too: it stands there as that does.
    pub(super) fn alias(&mut self, key: Key, of: Key) {
        if self.guarded.contains(&key) {
            self.wanted_guards.insert(of);
        }
        if self.read.contains(&of) {
            self.read.insert(key);
        }
        if self.beside.contains(&key) {
            self.wanted_beside.insert(of);
        }
        if let Some(more) = self.finer.get(&key).copied() {
            let own = self.wanted.entry(of).or_insert(0);
            *own = (*own).max(more);
        }
        if let (Some(print), false) = (self.printed.get(&of).cloned(), self.printed.contains_key(&key)) {
            self.printed.insert(key, print);
        }
    }

    /// A number as it is printed.
    pub(super) fn print_of(&self, key: Key) -> Option<&Print> {
        self.printed.get(&key)
    }

    /// The number to which the steps have come for a value, with its sign; none where they have not told it, or where they
    /// have come farther from it than readings of four figures and what follows from their squares can: the result is then
    /// its own number, rounded once.
    pub(super) fn told(&self, key: Key, si: f64, method: Method) -> Option<f64> {
        /// Half a unit in the fourth figure is 0.05 % of a reading at most, and twice that of its square.
        const OF_READINGS: f64 = 1e-3;
        let print = match method {
            Method::Polygon => self.printed.get(&key)?,
            // Constructions on the skeleton have readings of their own.
            method => self.carried_over.get(&(method, key))?,
        };
        let exact = si.abs() / print.unit.si;
        let room = human::last_place(exact).max(OF_READINGS * exact);
        let near = (print.number - exact).abs() <= room * (1.0 + 1e-9);
        near.then_some(libm::copysign(print.number * print.unit.si, si))
    }

    /// Whether a result that the steps have told would stand in a table otherwise than it is: rounded from numbers that were
    /// rounded before.
    pub(super) fn is_off(&self, key: Key, si: f64, unit: &Unit) -> bool {
        let Some(print) = self.printed.get(&key) else { return false };
        let [told, own] = [print.number * print.unit.si / unit.si, si.abs() / unit.si];
        human::is_off(told, own)
    }

    /// Whether a number is printed already.
    pub(super) fn has(&self, key: Key) -> bool {
        self.printed.contains_key(&key)
    }

    /// The factors of a line as they are printed, and its result: that of the printed factors.
    pub(super) fn line<const N: usize>(
        &mut self,
        factors: [(Key, f64, &Unit); N],
        (key, si, unit): (Key, f64, &Unit),
        reckon: impl Fn([f64; N]) -> f64,
    ) -> ([Rich; N], Rich) {
        let factors = factors.map(|(key, si, unit)| (Some(key), si, unit));
        let reckon = |numbers: &[f64]| reckon(std::array::from_fn(|i| numbers[i]));
        let (numbers, text, _) = self.reckoned(&factors, (Some(key), si.abs(), unit), reckon, Room::OF_ALL);
        (std::array::from_fn(|i| numbers[i].clone()), text)
    }

    /// The same of as many factors as there are; what has no key stands in no other line. A result that the factors do not
    /// give in the figures of a sheet, a small difference, is given by as many figures as it takes. Last the number that
    /// stands there for the result.
    pub(super) fn line_of(
        &mut self,
        factors: &[(Option<Key>, f64, &Unit)],
        result: (Option<Key>, f64, &Unit),
        reckon: impl Fn(&[f64]) -> f64,
    ) -> (Vec<Rich>, Rich, f64) {
        self.reckoned(factors, result, reckon, Room::OF_READINGS)
    }

    /// The same of a line of which every factor stands in a line before it: it takes them as they stand there, a small difference
    /// too.
    pub(super) fn line_from(
        &mut self,
        factors: &[(Option<Key>, f64, &Unit)],
        result: (Option<Key>, f64, &Unit),
        reckon: impl Fn(&[f64]) -> f64,
    ) -> (Vec<Rich>, Rich, f64) {
        self.reckoned(factors, result, reckon, Room::OF_SUMS)
    }

    fn reckoned(
        &mut self,
        factors: &[(Option<Key>, f64, &Unit)],
        (key, si, unit): (Option<Key>, f64, &Unit),
        reckon: impl Fn(&[f64]) -> f64,
        room: Room,
    ) -> (Vec<Rich>, Rich, f64) {
        let exact = si / unit.si;
        let more = key.map_or(0, |key| self.more(key));
        if key.is_some_and(|key| self.guarded.contains(&key)) {
            self.wanted_guards.extend(factors.iter().filter_map(|(key, ..)| *key));
        }
        let (mut text, mut number) = human::limited(exact, more);
        // What stands in no other line has as many figures as this one takes to close.
        let mut tell = |finer: usize| -> Vec<(Rich, f64)> {
            let told = factors.iter().map(|(key, si, unit)| match key {
                Some(key) => self.number(*key, *si, unit),
                None => {
                    let own = si.abs() / unit.si;
                    let usual = human::figures_of_reading(own, 0);
                    human::given(own, finer.min(room.figures.saturating_sub(usual)))
                }
            });
            told.collect()
        };
        let printed = |told: &[(Rich, f64)]| told.iter().map(|(_, number)| *number).collect::<Vec<f64>>();
        let mut told = tell(0);
        if factors.iter().any(|(key, ..)| key.is_none()) {
            let off = |told: &Vec<(Rich, f64)>| (reckon(&printed(told)) - exact).abs();
            let closes = |told: &Vec<(Rich, f64)>| human::agrees(reckon(&printed(told)), number, exact, more);
            let all: Vec<Vec<(Rich, f64)>> = (0..=MOST_MORE).map(tell).collect();
            // Where none closes the line ends in what comes nearest.
            let nearest = all.iter().min_by(|a, b| off(a).total_cmp(&off(b)));
            told = all.iter().find(|told| closes(told)).or(nearest).cloned().unwrap_or_default();
        }
        let printed = printed(&told);
        let mut numbers: Vec<Rich> = told.into_iter().map(|(text, _)| text).collect();
        let reckoned = reckon(&printed);
        if !human::agrees(reckoned, number, exact, more) {
            // What was read is no nearer to the truth for its figures.
            let rounded = factors.iter().zip(&printed).all(|((key, si, unit), number)| {
                let (exact, more) = (si.abs() / unit.si, key.map_or(0, |key| self.more(key)));
                human::agrees(exact, *number, exact, more)
            });
            let most = if rounded { MOST_MORE } else { 1 };
            // Not as long as figures may do: a neighbour that makes up for a coarse factor is wrong beside a finer one.
            let settled = factors.iter().filter_map(|(key, ..)| *key).all(|key| self.more(key) >= most);
            if settled && !key.is_some_and(is_a_square) {
                self.want_beside(factors, &printed, (reckoned, exact), &reckon);
            }
            for key in factors.iter().filter_map(|(key, ..)| *key) {
                let more = (self.more(key) + 1).min(most);
                let own = self.wanted.entry(key).or_insert(0);
                *own = (*own).max(more);
            }
            if (reckoned - exact).abs() <= room.far * exact.abs() {
                (text, number) = match key {
                    // Of what nothing follows.
                    Some(Key::Of(Quantity::Force(Force::Torque(_) | Force::Drive(_), _))) => {
                        human::in_common(reckoned, exact, more)
                    }
                    _ => human::limited(reckoned, more),
                };
            } else {
                let values: Vec<f64> = factors.iter().map(|(_, si, unit)| si.abs() / unit.si).collect();
                numbers = human::closing_all(&values, exact, &reckon);
            }
        }
        if let Some(key) = key {
            // Elsewhere it is a size, and the sign before it tells its sense.
            let size = if number < 0.0 { human::limited(number.abs(), more).0 } else { text.clone() };
            self.note(key, &size, (number.abs(), exact.abs()), unit);
        }
        (numbers, text, number)
    }
}

/// Whether a number is reckoned from the square or the product of readings, only to be laid off: no reading is told otherwise
/// for its sake, since from the same reading a rate follows.
fn is_a_square(key: Key) -> bool {
    let (Key::Of(quantity) | Key::From(quantity, _)) = key else { return false };
    matches!(
        quantity,
        Quantity::Normal(_)
            | Quantity::RelativeNormal(..)
            | Quantity::CoincidentNormal(..)
            | Quantity::SlipNormal(..)
            | Quantity::TurningNormal(..)
            | Quantity::Coriolis(..)
    )
}

/// Whether a number is the rate of a driven link.
fn is_driven(key: Key, notation: &Notation<'_>) -> bool {
    let Key::Of(Quantity::Omega(own) | Quantity::Alpha(own)) = key else { return false };
    notation.mechanism().inputs.iter().any(|input| match input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => *link == own,
        Input::Slide { .. } => false,
    })
}

/// Relative to a fixed point is not relative.
pub(super) fn absolute(quantity: Quantity, notation: &Notation<'_>) -> Quantity {
    match quantity {
        Quantity::RelativeVelocity(p, q) if notation.mechanism().is_fixed(q) => Quantity::Velocity(p),
        Quantity::RelativeAcceleration(p, q) if notation.mechanism().is_fixed(q) => Quantity::Acceleration(p),
        Quantity::RelativeNormal(p, q) if notation.mechanism().is_fixed(q) => Quantity::Normal(p),
        Quantity::RelativeTangential(p, q) if notation.mechanism().is_fixed(q) => Quantity::Tangential(p),
        Quantity::Slip(p, LinkId::FRAME) => Quantity::Velocity(p),
        Quantity::Force(Force::Vector(action), share) => {
            Quantity::Force(Force::Vector(either(action)), share)
        }
        other => other,
    }
}

/// Action and reaction are one number.
pub(super) fn either(action: Action) -> Action {
    match action {
        Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
        Action::OnPin(link, pin) => Action::OfPin(pin, link),
        Action::DriveBack(input) => Action::Drive(input),
        Action::Spring { index, .. } => Action::Spring { index, end: 0 },
        other => other,
    }
}
