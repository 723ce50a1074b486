//! The turning-moment diagram in closed form: integrals of tables and harmonics, crossings by bracketing and Newton's
//! iteration, and of a mechanism's own torque the work from energies: what kinetic energy, weights and springs have at one
//! angle less what they had at another, and the work of the loads between.
//!
//! Nothing here knows a trapezium, a parabola or a drawn height.

use super::cycle_work::OwnTorque;
use super::tape::U;
use crate::mechanism::curve::{Curve, Harmonic};
use crate::mechanism::cycle::{Course, Cycle, CycleQuantity, RotatingInertia, Sides};
use crate::mechanism::quantity::{Answer, Indeterminate};
use crate::mechanism::{Given, Mechanism};

/// The mechanism with its input at an angle; none where it cannot stand there.
pub type Standing<'a> = &'a dyn Fn(f64) -> Option<Mechanism>;

/// Between two angles of a period a smooth curve is looked at so often.
const LOOKS: u32 = 1440;
/// Of a mechanism, whose every look is a solution, so often.
const FEW_LOOKS: u32 = 90;
/// Less than this part of the largest torque is zero.
const ZERO: f64 = 1e-12;

/// Nearer than this part of the period to its beginning no crossing is surely the first.
const BEGINNING: f64 = 1e-9;
/// What parts two crossings all but touches where it is no more than so many zeros.
const TOUCH: f64 = 1e3;
/// A top is followed until it is known to this part of the period, which is less than its height tells.
const TOP: f64 = 1e-11;

/// A diagram solved in closed form.
#[derive(Debug, Clone, PartialEq)]
pub struct Turning {
    period: f64,
    omega: f64,
    /// The angle of the input falls as time goes on.
    falling: bool,
    fluctuation: Option<f64>,
    inertia: Option<f64>,
    /// None of areas alone.
    mean: Option<Known>,
    crossings: Vec<Known>,
    levels: Vec<Known>,
    areas: Vec<Known>,
    by_areas: bool,
    extremes: Option<[usize; 2]>,
    /// Why the crossings cannot be numbered.
    unnumbered: Option<&'static str>,
    /// The greatest and the least difference of the torques: where and how much.
    steepest: Option<[(Known, Known); 2]>,
}

/// A top of a curve: where, how high, and how far it may be from there.
#[derive(Debug, Clone, Copy)]
struct Top {
    at: f64,
    value: f64,
    loose: f64,
}

/// A number with its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Known {
    pub(super) value: f64,
    pub(super) bound: f64,
}

impl Known {
    fn times(self, by: f64) -> Self {
        let value = self.value * by;
        Self { value, bound: self.bound * by.abs() + 16.0 * U * value.abs() }
    }

    fn less(self, other: Self) -> Self {
        let value = self.value - other.value;
        Self { value, bound: self.bound + other.bound + 2.0 * U * value.abs() }
    }

    fn answer(self) -> Answer {
        Answer::Scalar { value: self.value, bound: self.bound }
    }
}

pub(super) type Told<T> = Result<T, String>;

/// A torque that can be asked for its value and its integral.
enum Torque<'a> {
    Table { start: f64, knots: Vec<[f64; 2]>, period: f64 },
    Harmonics { constant: f64, sin: Vec<[f64; 2]>, cos: Vec<[f64; 2]> },
    Of(OwnTorque<'a>),
}

fn waves(of: &[Harmonic]) -> Vec<[f64; 2]> {
    of.iter().map(|wave| [wave.order.value, wave.size.value]).collect()
}

impl<'a> Torque<'a> {
    fn new(course: &Course, sign: f64, period: f64, standing: Option<Standing<'a>>) -> Told<Self> {
        Ok(match course {
            Course::Of(_) => {
                Self::Of(OwnTorque::new(standing.ok_or("the mechanism does not move")?, sign, period)?)
            }
            Course::Curve(Curve::Table { knots, period }) => Self::Table {
                start: knots.first().ok_or("the table is empty")?[0].value,
                knots: knots.iter().map(|[at, size]| [at.value, size.value]).collect(),
                period: period.value,
            },
            Course::Curve(Curve::Harmonics { constant, sin, cos }) => {
                Self::Harmonics { constant: constant.value, sin: waves(sin), cos: waves(cos) }
            }
        })
    }

    /// The segments of a table over its own period, with the one that closes it.
    fn segments(knots: &[[f64; 2]], period: f64) -> Vec<[[f64; 2]; 2]> {
        let mut all: Vec<[[f64; 2]; 2]> = knots.windows(2).map(|pair| [pair[0], pair[1]]).collect();
        if let (Some(first), Some(last)) = (knots.first(), knots.last()) {
            all.push([*last, [first[0] + period, first[1]]]);
        }
        all
    }

    /// The value just before or just after an angle.
    fn value(&self, at: f64, after: bool) -> Told<f64> {
        match self {
            Self::Table { start, knots, period } => {
                let room = 64.0 * U * (at.abs() + period);
                let turns = libm::floor((at - start) / period);
                // Half a room to the side from which one comes.
                let mut here = at - turns * period;
                if (here - start).abs() <= room && !after {
                    here += period;
                } else if (start + period - here).abs() <= room && after {
                    here -= period;
                }
                let mut found = None;
                for [from, to] in Self::segments(knots, *period) {
                    if to[0] - from[0] <= room {
                        continue;
                    }
                    let inside = if after {
                        from[0] - room <= here && here < to[0] - room
                    } else {
                        from[0] + room < here && here <= to[0] + room
                    };
                    if inside {
                        let part = ((here - from[0]) / (to[0] - from[0])).clamp(0.0, 1.0);
                        found = Some(from[1] + (to[1] - from[1]) * part);
                    }
                }
                found.ok_or_else(|| "the table says nothing there".to_owned())
            }
            Self::Harmonics { constant, sin, cos } => {
                let of_sin = sin.iter().map(|[k, size]| size * libm::sin(k * at));
                let of_cos = cos.iter().map(|[k, size]| size * libm::cos(k * at));
                Ok(constant + of_sin.sum::<f64>() + of_cos.sum::<f64>())
            }
            Self::Of(own) => own.torque(own.beside(at, after)).map(|torque| torque.value),
        }
    }

    /// ∫ from 0.
    fn integral(&self, at: f64) -> Told<f64> {
        match self {
            Self::Table { start, knots, period } => {
                let segments = Self::segments(knots, *period);
                let whole: f64 = segments.iter().map(|[a, b]| 0.5 * (a[1] + b[1]) * (b[0] - a[0])).sum();
                let from_start = |angle: f64| {
                    let turns = libm::floor((angle - start) / period);
                    let rest = angle - turns * period;
                    let parts = segments.iter().map(|[a, b]| {
                        let width = b[0] - a[0];
                        let x = (rest - a[0]).clamp(0.0, width.max(0.0));
                        if width <= 0.0 { 0.0 } else { a[1] * x + (b[1] - a[1]) * x * x / (2.0 * width) }
                    });
                    turns * whole + parts.sum::<f64>()
                };
                Ok(from_start(at) - from_start(0.0))
            }
            Self::Harmonics { constant, sin, cos } => {
                let of_sin = sin.iter().map(|[k, size]| {
                    // 1 − cos, without cancelling.
                    let half = libm::sin(k * at / 2.0);
                    size * 2.0 * half * half / k
                });
                let of_cos = cos.iter().map(|[k, size]| size * libm::sin(k * at) / k);
                Ok(constant * at + of_sin.sum::<f64>() + of_cos.sum::<f64>())
            }
            Self::Of(own) => own.work(at).map(|work| work.value),
        }
    }

    fn size(&self) -> f64 {
        match self {
            Self::Table { knots, .. } => knots.iter().map(|knot| knot[1].abs()).fold(0.0, f64::max),
            Self::Harmonics { constant, sin, cos } => {
                constant.abs() + sin.iter().chain(cos).map(|wave| wave[1].abs()).sum::<f64>()
            }
            Self::Of(_) => 0.0,
        }
    }

    /// How far a value may be off besides the rounding of what is given.
    fn loose(&self, at: f64) -> Told<f64> {
        match self {
            Self::Of(own) => own.torque(at).map(|torque| torque.bound),
            Self::Table { .. } | Self::Harmonics { .. } => Ok(0.0),
        }
    }

    /// The same of the integral.
    fn loose_work(&self, at: f64) -> Told<f64> {
        match self {
            Self::Of(own) => own.work(at).map(|work| work.bound),
            Self::Table { .. } | Self::Harmonics { .. } => Ok(0.0),
        }
    }
}

/// Both torques with their copies.
struct Curves<'a> {
    sides: [Option<Torque<'a>>; 2],
    copies: (u32, f64),
    /// 1, or −1 where the angle of the input falls: everything is a function of what has been turned since angle 0.
    way: f64,
    means: [f64; 2],
    scale: f64,
    period: f64,
}

impl Curves<'_> {
    fn side(&self, side: usize, at: f64, after: bool) -> Told<f64> {
        let Some(torque) = &self.sides[side] else { return Ok(self.means[1 - side]) };
        let (number, shift) = self.copies;
        let after = after == (self.way > 0.0);
        (0..number).map(|copy| torque.value(self.way * (at - f64::from(copy) * shift), after)).sum()
    }

    /// How far the difference may be off where a mechanism gives one of the torques.
    fn loose(&self, at: f64) -> Told<f64> {
        let (number, shift) = self.copies;
        let mut sum = 0.0;
        for torque in self.sides.iter().flatten() {
            for copy in 0..number {
                sum += torque.loose(self.way * (at - f64::from(copy) * shift))?;
            }
        }
        Ok(sum)
    }

    fn loose_work(&self, at: f64) -> Told<f64> {
        let (number, shift) = self.copies;
        let mut sum = 0.0;
        for torque in self.sides.iter().flatten() {
            for copy in 0..number {
                let by = f64::from(copy) * shift;
                sum += torque.loose_work(self.way * (at - by))? + torque.loose_work(-self.way * by)?;
            }
        }
        Ok(sum)
    }

    /// At so many angles of a period a smooth curve is looked at.
    fn many(&self) -> u32 {
        let own = self.sides.iter().flatten().any(|torque| matches!(torque, Torque::Of(_)));
        if own { FEW_LOOKS } else { LOOKS }
    }

    fn net(&self, at: f64, after: bool) -> Told<f64> {
        Ok(self.side(0, at, after)? - self.side(1, at, after)?)
    }

    fn work(&self, side: usize, at: f64) -> Told<f64> {
        let Some(torque) = &self.sides[side] else { return Ok(self.means[1 - side] * at) };
        let (number, shift) = self.copies;
        (0..number)
            .map(|copy| {
                let by = f64::from(copy) * shift;
                Ok(self.way * (torque.integral(self.way * (at - by))? - torque.integral(-self.way * by)?))
            })
            .sum()
    }

    fn level(&self, at: f64) -> Told<f64> {
        Ok(self.work(0, at)? - self.work(1, at)?)
    }

    /// Where a table bends, in the order of the motion within the period, with both ends.
    fn knots(&self) -> Vec<f64> {
        let (number, shift) = self.copies;
        let room = 64.0 * U * self.period;
        let mut knots = vec![0.0, self.period];
        for torque in self.sides.iter().flatten() {
            let own: Vec<[f64; 2]> = match torque {
                Torque::Table { knots, period, .. } => knots.iter().map(|knot| [knot[0], *period]).collect(),
                Torque::Of(own) => own.knots().to_vec(),
                Torque::Harmonics { .. } => continue,
            };
            for copy in 0..number {
                for [knot, period] in &own {
                    let angle = self.way * knot + f64::from(copy) * shift;
                    let mut at = angle - libm::floor(angle / period) * period;
                    while at < self.period {
                        knots.push(at);
                        at += period;
                    }
                }
            }
        }
        knots.sort_by(f64::total_cmp);
        knots.dedup_by(|a, b| (*a - *b).abs() <= room);
        knots.retain(|at| *at <= self.period);
        knots
    }

    fn smooth(&self) -> bool {
        self.sides.iter().flatten().any(|torque| !matches!(torque, Torque::Table { .. }))
    }
}

/// Solves a diagram.
///
/// # Errors
/// Why there is none, one clause.
pub(super) fn turning(
    cycle: &Cycle,
    g: Given,
    standing: Option<Standing<'_>>,
    steepest: bool,
) -> Result<Turning, String> {
    let inertia = cycle.rotating.iter().map(|rotating| {
        let central = match rotating.inertia {
            RotatingInertia::Central(inertia) => inertia.value,
            RotatingInertia::Mass(mass, radius) => mass.value * radius.value * radius.value,
            RotatingInertia::Weight(weight, radius) => weight.value / g.value * radius.value * radius.value,
        };
        central * rotating.ratio.value * rotating.ratio.value
    });
    let inertia = inertia.reduce(|sum, more| sum + more);
    let mut turning = Turning {
        period: cycle.period.value,
        omega: cycle.omega.value,
        falling: cycle.falling,
        fluctuation: cycle.fluctuation.map(|given| given.value),
        inertia,
        mean: None,
        crossings: Vec::new(),
        levels: Vec::new(),
        areas: Vec::new(),
        by_areas: false,
        extremes: None,
        unnumbered: None,
        steepest: None,
    };
    // What drives is positive, whichever way the input turns.
    let sense = if cycle.omega.value < 0.0 { -1.0 } else { 1.0 };
    let sides = match &cycle.sides {
        Sides::Areas { areas, torque, angle, total } => {
            turning.of_areas(areas, torque.value * angle.value, total.map(|total| total.value))?;
            return Ok(turning);
        }
        Sides::Torque(torque) => [Some(Torque::new(torque, -sense, cycle.period.value, standing)?), None],
        Sides::Load(load) => [None, Some(Torque::new(load, sense, cycle.period.value, standing)?)],
        Sides::Both { torque, load } => [
            Some(Torque::new(torque, -sense, cycle.period.value, standing)?),
            Some(Torque::new(load, sense, cycle.period.value, standing)?),
        ],
    };
    let number = cycle.copies.number;
    let sizes: f64 = sides.iter().flatten().map(Torque::size).sum();
    let mut curves = Curves {
        sides,
        copies: (number, cycle.copies.shift.value),
        way: if cycle.falling { -1.0 } else { 1.0 },
        means: [0.0; 2],
        scale: sizes * f64::from(number),
        period: cycle.period.value,
    };
    turning.of_curves(&mut curves, steepest)?;
    Ok(turning)
}

impl Turning {
    fn of_areas(&mut self, areas: &[Given], unit: f64, total: Option<f64>) -> Told<()> {
        let all: f64 = areas.iter().map(|area| area.value.abs()).sum();
        let sum: f64 = areas.iter().map(|area| area.value).sum();
        if sum.abs() > 1e-3 * all {
            return Err("the areas above and below the mean differ".to_owned());
        }
        if total == Some(0.0) {
            return Err("the mean torque is zero".to_owned());
        }
        let room = 64.0 * U * all * unit.abs();
        self.mean = total.map(|total| {
            let mean = total * unit / self.period;
            Known { value: mean, bound: 32.0 * U * mean.abs() }
        });
        self.areas = areas.iter().map(|area| Known { value: area.value * unit, bound: room }).collect();
        let mut level = 0.0;
        for area in areas {
            level += area.value;
            self.levels.push(Known { value: level * unit, bound: room });
        }
        self.by_areas = true;
        self.find_extremes();
        Ok(())
    }

    fn find_extremes(&mut self) {
        let levels: Vec<f64> = self.levels.iter().map(|level| level.value).collect();
        let (Some(most), Some(least)) =
            (levels.iter().copied().reduce(f64::max), levels.iter().copied().reduce(f64::min))
        else {
            return;
        };
        let room = 1e-9 * (most - least);
        let highest = levels.iter().position(|level| *level >= most - room);
        let lowest = levels.iter().position(|level| *level <= least + room);
        self.extremes = highest.zip(lowest).map(|(highest, lowest)| [highest, lowest]);
    }

    fn of_curves(&mut self, curves: &mut Curves<'_>, steepest: bool) -> Told<()> {
        let period = self.period;
        for torque in curves.sides.iter().flatten() {
            // A mechanism's torque is as large as it is seen to be.
            let Torque::Of(own) = torque else { continue };
            let mut most = 0.0_f64;
            for look in 0..FEW_LOOKS {
                most = most.max(own.torque(f64::from(look) / f64::from(FEW_LOOKS) * period)?.value.abs());
            }
            curves.scale += most * f64::from(curves.copies.0);
        }
        let works = [0, 1].map(|side| curves.sides[side].as_ref().map(|_| curves.work(side, period)));
        let [torque, load] = works;
        let (torque, load) = (torque.transpose()?, load.transpose()?);
        if curves.scale == 0.0 {
            return Err("the torque is zero throughout".to_owned());
        }
        let work = torque.or(load).ok_or("there is no curve")?;
        if work.abs() <= 1e-9 * curves.scale * period {
            return Err("the mean torque is zero".to_owned());
        }
        if let (Some(torque), Some(load)) = (torque, load)
            && (torque - load).abs() > 1e-3 * torque.abs().max(load.abs())
        {
            return Err("the two torques have different means".to_owned());
        }
        // A side that is missing is the mean of the other.
        curves.means = match (torque, load) {
            (Some(torque), Some(load)) => [torque / period, load / period],
            _ => [work / period; 2],
        };
        let knots = curves.knots();
        let many = 64.0 + 8.0 * knots.len() as f64;
        let height = many * U * curves.scale;
        let whole = curves.loose_work(period)?;
        let area = many * U * curves.scale * period + whole;
        let height = height + whole / period;
        self.mean = Some(Known { value: work / period, bound: area / period });
        self.find_crossings(curves, &knots, height)?;
        for at in &self.crossings {
            let loose = curves.loose_work(at.value)?;
            self.levels.push(Known { value: curves.level(at.value)?, bound: area + loose });
        }
        let whole = curves.level(period)?;
        for (index, from) in self.levels.iter().enumerate() {
            let to = self.levels.get(index + 1).map_or(self.levels[0].value + whole, |to| to.value);
            self.areas.push(Known { value: to - from.value, bound: 2.0 * area + from.bound });
        }
        self.find_extremes();
        if steepest { self.find_steepest(curves, &knots, height) } else { Ok(()) }
    }

    /// The angles of the pieces in which nothing leaps or bends.
    fn looks(curves: &Curves<'_>, knots: &[f64]) -> Vec<f64> {
        if !curves.smooth() {
            return knots.to_vec();
        }
        let mut looks = knots.to_vec();
        let many = curves.many();
        looks.extend((1..many).map(|i| f64::from(i) / f64::from(many) * curves.period));
        looks.sort_by(f64::total_cmp);
        let room = 1e-9 * curves.period;
        // A knot stays where it is.
        let mut kept: Vec<f64> = Vec::new();
        for at in looks {
            match kept.last_mut() {
                Some(last) if at - *last <= room => {
                    if knots.contains(&at) {
                        *last = at;
                    }
                }
                _ => kept.push(at),
            }
        }
        kept
    }

    fn find_crossings(&mut self, curves: &Curves<'_>, knots: &[f64], height: f64) -> Told<()> {
        let zero = ZERO * curves.scale;
        let sense = |net: f64| {
            if net.abs() <= zero {
                0
            } else if net > 0.0 {
                1
            } else {
                -1
            }
        };
        let looks = Self::looks(curves, knots);
        // Every value in its order, with the place it stands at.
        let mut values = Vec::new();
        let period = self.period;
        for (index, &at) in looks.iter().enumerate() {
            if index + 1 == looks.len() {
                values.push((at, curves.net(at, false)?));
                break;
            }
            let before = if index == 0 { curves.net(period, false)? } else { curves.net(at, false)? };
            values.push((at, before));
            values.push((at, curves.net(at, true)?));
        }
        if curves.smooth() {
            values = Self::with_dips(curves, values, zero)?;
        }
        let ended = values.iter().rev().map(|(_, net)| sense(*net)).find(|sense| *sense != 0);
        let mut last = ended.ok_or("the curves are one")?;
        let mut nonzero: Option<f64> = None;
        let mut resting: Option<f64> = None;
        let near = BEGINNING * period;
        // The greatest difference before each crossing, and after the last.
        let (mut peaks, mut peak) = (Vec::new(), 0.0_f64);
        for (at, net) in values {
            let now = sense(net);
            if now == 0 {
                resting.get_or_insert(at);
                continue;
            }
            if now != last {
                let place = match (resting, nonzero) {
                    (Some(rest), _) => rest,
                    (None, Some(from)) if from < at => Self::root(curves, from, at)?,
                    (None, _) => at,
                };
                let bound = match resting {
                    Some(_) => Self::spread(curves, place, zero, at)?,
                    None => self.slack(curves, place, height)?,
                };
                let leaps = resting.is_none() && knots.contains(&place);
                let vague = if place == 0.0 { bound > near } else { place <= near || place >= period - near };
                if vague && !(leaps && place == 0.0) {
                    self.unnumbered =
                        Some("so near the beginning of the period no crossing is surely the first");
                }
                if place < period {
                    self.crossings.push(Known { value: place, bound });
                    peaks.push(peak);
                    peak = 0.0;
                }
                last = now;
            }
            peak = peak.max(net.abs());
            nonzero = Some(at);
            resting = None;
        }
        if let Some(first) = peaks.first_mut() {
            *first = first.max(peak);
        }
        if peaks.iter().any(|peak| *peak <= TOUCH * zero) {
            self.unnumbered = Some("the curves all but touch");
        }
        Ok(())
    }

    /// How far a crossing may be off by errors of the heights.
    fn slack(&self, curves: &Curves<'_>, place: f64, height: f64) -> Told<f64> {
        let period = self.period;
        let near = 1e-7 * period;
        let [low, high] = [place - near, place + near].map(|at| curves.net(at, true));
        let slope = ((high? - low?) / (2.0 * near)).abs();
        // At a knot the place is the knot's.
        let of_place = 32.0 * U * (period + place.abs());
        let height = height + curves.loose(place)?;
        if slope > 0.0 { Ok(of_place + 2.0 * height / slope) } else { Ok(near) }
    }

    /// How far the curves may cross from an angle where they are not told apart: to where they are, on either side, if
    /// they part at once. Where they are one for as long as one sees, that angle it is.
    fn spread(curves: &Curves<'_>, place: f64, zero: f64, parted: f64) -> Told<f64> {
        let period = curves.period;
        let step = period / f64::from(curves.many());
        let mut most = 32.0 * U * (period + place);
        for side in [-1.0, 1.0] {
            // They rest for more than one look.
            if side > 0.0 && parted - place > 1.5 * step {
                continue;
            }
            let from = if side < 0.0 && place == 0.0 { period } else { place };
            let room = 4.0 * zero + curves.loose(place)?;
            let mut by = step * libm::exp2(-40.0);
            while by < step && curves.net(from + side * by, side > 0.0)?.abs() <= room {
                by *= 2.0;
            }
            if by < step {
                most = most.max(by);
            }
        }
        Ok(most)
    }

    /// Besides what is seen the bottoms of dips between two looks in which one curve passes through the other.
    fn with_dips(curves: &Curves<'_>, values: Vec<(f64, f64)>, zero: f64) -> Told<Vec<(f64, f64)>> {
        let mut all = Vec::with_capacity(values.len());
        for (index, &(from, first)) in values.iter().enumerate() {
            all.push((from, first));
            let Some(&(to, second)) = values.get(index + 1) else { break };
            let sense = |net: f64| if net.abs() <= zero { 0.0 } else { net.signum() };
            // From where they are one they may part and cross once more at once.
            let up = (sense(first) + sense(second)).clamp(-1.0, 1.0);
            if to <= from || up == 0.0 || first.abs().min(second.abs()) > 0.05 * curves.scale {
                continue;
            }
            let net = |at: f64| curves.net(at, true).map(|net| up * net);
            let step = 1e-3 * (to - from);
            if net(from + step)? >= up * first || net(to - step)? >= up * second {
                continue;
            }
            let (mut low, mut high) = (from, to);
            let golden = 0.618_033_988_749_894_9;
            for _ in 0..80 {
                let (a, b) = (high - golden * (high - low), low + golden * (high - low));
                if net(a)? <= net(b)? { high = b } else { low = a }
            }
            let bottom = f64::midpoint(low, high);
            let depth = net(bottom)?;
            if bottom > from && bottom < to && depth < -zero {
                all.push((bottom, up * depth));
            }
        }
        Ok(all)
    }

    /// The root between two angles: Newton's steps by a secant slope, kept within halves of the bracket.
    fn root(curves: &Curves<'_>, from: f64, to: f64) -> Told<f64> {
        let (mut low, mut high) = (from, to);
        let (low_net, high_net) = (curves.net(low, true)?, curves.net(high, false)?);
        let rises = high_net > low_net;
        let mut at = low - low_net * (high - low) / (high_net - low_net);
        for _ in 0..200 {
            if !(at > low && at < high) {
                at = f64::midpoint(low, high);
            }
            let net = curves.net(at, true)?;
            if net == 0.0 || high - low <= 4.0 * U * high.abs() {
                break;
            }
            if (net > 0.0) == rises {
                high = at
            } else {
                low = at
            }
            let step = (1e-6 * (to - from)).max(16.0 * U * at.abs());
            let ends = [(at - step).max(from), (at + step).min(to)];
            let slope = (curves.net(ends[1], false)? - curves.net(ends[0], true)?) / (ends[1] - ends[0]);
            let next = at - net / slope;
            if next == at {
                break;
            }
            at = next;
        }
        Ok(at.clamp(from, to))
    }

    fn find_steepest(&mut self, curves: &Curves<'_>, knots: &[f64], height: f64) -> Told<()> {
        let looks = Self::looks(curves, knots);
        let mut found = Vec::new();
        for up in [1.0, -1.0] {
            let net = |at: f64, after: bool| curves.net(at, after).map(|net| up * net);
            let mut values = Vec::new();
            for (index, &at) in looks.iter().enumerate() {
                if index > 0 {
                    values.push((at, net(at, false)?));
                }
                if index + 1 < looks.len() {
                    values.push((at, net(at, true)?));
                }
            }
            // What comes before angle 0 is the end of the period.
            if let Some((at, value)) = values.last().copied()
                && looks.len() > 1
            {
                values.insert(0, (at - self.period, value));
            }
            values.dedup();
            let Top { at: place, value, loose } = Self::highest(curves, knots, &values, (up, height))?;
            found.push((
                Known { value: place, bound: loose },
                Known {
                    value: up * value,
                    bound: height + self.mean.map_or(0.0, |mean| mean.bound) + curves.loose(place)?,
                },
            ));
        }
        if let [most, least] = found[..] {
            self.steepest = Some([most, least]);
        }
        Ok(())
    }

    /// The greatest of the values of one side, and of equal ones the first: every look that stands as high as its
    /// neighbours is followed to the top beside it, for two tops of one height are seen at different depths.
    fn highest(
        curves: &Curves<'_>,
        knots: &[f64],
        values: &[(f64, f64)],
        (up, height): (f64, f64),
    ) -> Told<Top> {
        let most = values.iter().map(|(_, value)| *value).fold(f64::NEG_INFINITY, f64::max);
        let room = 1e-9 * curves.scale;
        let seen = |value: f64, at: f64| Top { at, value, loose: 32.0 * U * curves.period };
        let mut tops = Vec::new();
        for (index, &(at, value)) in values.iter().enumerate() {
            let beside =
                |index: Option<usize>| index.and_then(|index| values.get(index)).map(|(_, value)| *value);
            let [before, after] = [beside(index.checked_sub(1)), beside(Some(index + 1))]
                .map(|beside| beside.unwrap_or(f64::NEG_INFINITY));
            if value < before.max(after) {
                continue;
            }
            // A parabola through three looks rises above the middle one by an eighth of how much they bend at most.
            let bends = 2.0 * value - before.max(f64::MIN) - after.max(f64::MIN);
            let mut top = seen(value, at);
            if curves.smooth() && bends > room && value + bends.min(2.0 * curves.scale) >= most {
                top = Self::top(curves, knots, top, (up, height))?;
            } else if value < most - room {
                continue;
            }
            // The place within the period; what is not told from its beginning is there.
            top.at -= libm::floor((top.at + top.loose) / curves.period) * curves.period;
            if top.at <= top.loose {
                top.at = 0.0;
            }
            tops.push(top);
        }
        let most = tops.iter().map(|top| top.value).fold(f64::NEG_INFINITY, f64::max);
        let first = tops.into_iter().filter(|top| top.value >= most - room);
        first.min_by(|one, other| one.at.total_cmp(&other.at)).ok_or_else(|| "there is no curve".to_owned())
    }

    /// The top of a smooth curve beside a look, no farther than the next look and no knot between.
    fn top(curves: &Curves<'_>, knots: &[f64], seen: Top, (up, height): (f64, f64)) -> Told<Top> {
        let net = |at: f64| curves.net(at, true).map(|net| up * net);
        let Top { at, value, mut loose } = seen;
        let step = curves.period / f64::from(curves.many());
        let height = height + curves.loose(at)?;
        let beyond = |by: f64| {
            let end = at + by;
            let inside = knots.iter().find(|knot| (**knot - end) * (**knot - at) < 0.0);
            inside.copied().unwrap_or(end)
        };
        let (mut low, mut high) = (beyond(-step), beyond(step));
        let golden = 0.618_033_988_749_894_9;
        let (mut a, mut b) = (high - golden * (high - low), low + golden * (high - low));
        let (mut of_a, mut of_b) = (net(a)?, net(b)?);
        while high - low > TOP * curves.period {
            if of_a >= of_b {
                (high, b, of_b) = (b, a, of_a);
                a = high - golden * (high - low);
                of_a = net(a)?;
            } else {
                (low, a, of_a) = (a, b, of_b);
                b = low + golden * (high - low);
                of_b = net(b)?;
            }
        }
        let top = f64::midpoint(low, high);
        let at_top = net(top)?;
        if at_top <= value {
            return Ok(seen);
        }
        let quarter = step / 4.0;
        let bend = (net(top - quarter)? - 2.0 * at_top + net(top + quarter)?) / (quarter * quarter);
        loose += high - low;
        if bend < 0.0 {
            loose += 2.0 * libm::sqrt(2.0 * (height + 64.0 * U * curves.scale) / -bend);
        }
        Ok(Top { at: top, value: at_top, loose })
    }

    fn fluctuation_of_energy(&self) -> Told<Known> {
        let [highest, lowest] = self.extremes.ok_or("the curves do not cross")?;
        Ok(self.levels[highest].less(self.levels[lowest]))
    }

    fn square(&self) -> Told<f64> {
        if self.omega == 0.0 { Err("the input rests".to_owned()) } else { Ok(self.omega * self.omega) }
    }

    fn needed(&self, wanted: f64) -> Told<Known> {
        Ok(self.fluctuation_of_energy()?.times(1.0 / (wanted * self.square()?)))
    }

    fn all_that_turns(&self) -> Told<Known> {
        let there = self.inertia.map(|inertia| Known { value: inertia, bound: 32.0 * U * inertia });
        let needed = self.fluctuation.map(|wanted| self.needed(wanted)).transpose()?;
        match (needed, there) {
            (Some(needed), Some(there)) if there.value > needed.value => Ok(there),
            (Some(needed), _) => Ok(needed),
            (None, Some(there)) => Ok(there),
            (None, None) => Err("nothing is said of what turns".to_owned()),
        }
    }

    /// The angle of the input where so much has been turned since angle 0.
    fn angle_told(&self, turned: Known) -> Known {
        if !self.falling || turned.value == 0.0 {
            return turned;
        }
        Known { value: self.period - turned.value, bound: turned.bound + 2.0 * U * self.period }
    }

    /// A number of the diagram.
    pub(super) fn answer(&self, of: CycleQuantity) -> Answer {
        self.told(of)
            .map_or_else(|why| Answer::Indeterminate(Indeterminate::Undefined { why }), Known::answer)
    }

    fn told(&self, of: CycleQuantity) -> Told<Known> {
        let quotient = |a: Known, b: Known| {
            let value = a.value / b.value;
            let bound = (a.bound + value.abs() * b.bound) / b.value.abs() + 16.0 * U * value.abs();
            Known { value, bound: 1.01 * bound }
        };
        let at = |k: u32, of: &[Known]| -> Told<Known> {
            (k as usize)
                .checked_sub(1)
                .and_then(|index| of.get(index))
                .copied()
                .ok_or_else(|| format!("there are {} of them", of.len()))
        };
        let extreme =
            |which: usize| -> Told<usize> { Ok(self.extremes.ok_or("the curves do not cross")?[which]) };
        let of_mean = || self.mean.ok_or("areas alone do not tell the mean");
        let unplaced = "areas alone do not say at which angle";
        if let Some(why) = self.unnumbered.filter(|_| of.counts_crossings()) {
            return Err(why.to_owned());
        }
        match of {
            CycleQuantity::Mean => Ok(of_mean()?),
            CycleQuantity::Work => Ok(of_mean()?.times(self.period)),
            CycleQuantity::Power => {
                self.square()?;
                Ok(of_mean()?.times(self.omega.abs()))
            }
            CycleQuantity::Highest => Ok(self.levels[extreme(0)?]),
            CycleQuantity::Lowest => Ok(self.levels[extreme(1)?]),
            CycleQuantity::Fluctuation => self.fluctuation_of_energy(),
            CycleQuantity::OfEnergy => {
                let work = of_mean()?.times(self.period);
                let work = Known { value: work.value.abs(), ..work };
                Ok(quotient(self.fluctuation_of_energy()?, work))
            }
            CycleQuantity::OfSpeed => {
                let heavy = |wanted| {
                    let needed = self.needed(wanted).ok();
                    self.inertia.zip(needed).is_some_and(|(there, needed)| there > needed.value)
                };
                if let Some(wanted) = self.fluctuation.filter(|wanted| !heavy(*wanted)) {
                    return Ok(Known { value: wanted, bound: 4.0 * U * wanted });
                }
                let by = self.all_that_turns()?.times(self.square()?);
                let part = quotient(self.fluctuation_of_energy()?, by);
                if part.value >= 2.0 { Err("what turns is too light".to_owned()) } else { Ok(part) }
            }
            CycleQuantity::Flywheel => {
                let wanted = self.fluctuation.ok_or("no `fluctuation` is wanted")?;
                let needed = self.needed(wanted)?;
                let still = match self.inertia {
                    Some(there) => needed.less(Known { value: there, bound: 32.0 * U * there }),
                    None => needed,
                };
                if still.value < 0.0 { Err("no flywheel is needed".to_owned()) } else { Ok(still) }
            }
            CycleQuantity::Inertia => {
                let there = self.inertia.ok_or("nothing is said of what turns")?;
                Ok(Known { value: there, bound: 32.0 * U * there })
            }
            CycleQuantity::Crossing(_) | CycleQuantity::AtHighest | CycleQuantity::AtLowest
                if self.by_areas =>
            {
                Err(unplaced.to_owned())
            }
            CycleQuantity::Crossing(k) => Ok(self.angle_told(at(k, &self.crossings)?)),
            CycleQuantity::Area(k) => at(k, &self.areas),
            CycleQuantity::Level(k) => at(k, &self.levels),
            CycleQuantity::AtHighest => Ok(self.angle_told(self.crossings[extreme(0)?])),
            CycleQuantity::AtLowest => Ok(self.angle_told(self.crossings[extreme(1)?])),
            CycleQuantity::Most | CycleQuantity::Least => {
                let steepest = self.steepest.ok_or(unplaced)?;
                let (_, net) = steepest[usize::from(of == CycleQuantity::Least)];
                Ok(quotient(net, self.all_that_turns()?))
            }
            CycleQuantity::AtMost | CycleQuantity::AtLeast => {
                let steepest = self.steepest.ok_or(unplaced)?;
                Ok(self.angle_told(steepest[usize::from(of == CycleQuantity::AtLeast)].0))
            }
        }
    }
}
