//! Where in a sweep something that rubs, or a load against a motion, turns round: forces leap there, and both sides are
//! told.

use super::{Event, EventKind, Measure, Over, Sweep};
use crate::mechanism::force::LoadKind;
use crate::mechanism::friction::{Friction, RubbingPair};
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::mechanism::{LinkId, Mechanism};

/// So many places of the range are looked at.
const LOOKS: usize = 720;
/// So often the way between two of them is halved.
const HALVINGS: usize = 60;
/// So far beside a reversal, as a part of the range, the forces of its sides are looked at.
const BESIDE: f64 = 1e-6;
/// What differs on both sides by no more than this part of itself does not leap.
const LEAP: f64 = 1e-6;
/// Nor what differs by no more than this part of its change on the way to the farther look: that is what is left of a straight
/// line through both, as of a torque that passes zero where the piston stands.
const OF_WAY: f64 = 1e-3;

/// A place at which motion turns round.
#[derive(Debug, Clone, PartialEq)]
pub struct Reversal {
    /// The input, SI units.
    pub at: f64,
    /// What turns round there.
    pub what: Vec<String>,
    /// The columns just before and just after it, SI units; none where there is no balance.
    pub sides: [Vec<Option<f64>>; 2],
    /// The columns a little before and a little after, by which one sees how they go on.
    beside: [Vec<Option<f64>>; 2],
}

/// A number just beside a reversal, and a little farther from it.
struct Side {
    limit: f64,
    farther: f64,
}

impl Reversal {
    /// Whether a column leaps there, or, `of_vector`, the size of the vector that begins with it.
    #[must_use]
    pub fn leaps(&self, column: usize, of_vector: bool) -> bool {
        let measure =
            if of_vector { Measure::Magnitude([column, column + 1]) } else { Measure::Column(column) };
        self.leap(measure).is_some()
    }

    /// Before and after, where what is measured leaps.
    fn leap(&self, measure: Measure) -> Option<[Side; 2]> {
        let number = |columns: &[Option<f64>]| match measure {
            Measure::Column(column) => *columns.get(column)?,
            Measure::Magnitude([x, y]) => Some(libm::hypot((*columns.get(x)?)?, (*columns.get(y)?)?)),
        };
        let side =
            |of: usize| Some(Side { limit: number(&self.sides[of])?, farther: number(&self.beside[of])? });
        let both = [side(0)?, side(1)?];
        let size = both.iter().map(|side| side.limit.abs()).fold(0.0, f64::max);
        let way = both.iter().map(|side| (side.farther - side.limit).abs()).fold(0.0, f64::max);
        let by = (both[0].limit - both[1].limit).abs();
        (by > (LEAP * size).max(OF_WAY * way)).then_some(both)
    }

    /// What is extreme on either side of the leap: a force falls away from the higher side of a greatest value and rises
    /// from the lower side of a least one.
    fn extremes(&self, measure: Measure, [before, after]: &[Side; 2]) -> Vec<Event> {
        let (high, low) = if before.limit > after.limit { (before, after) } else { (after, before) };
        let column = measure.first();
        let event = |kind: EventKind| Event { at: self.at, kind, reason: None };
        let mut found = Vec::new();
        if high.farther < high.limit {
            found.push(event(EventKind::Greatest { column, value: high.limit }));
        }
        if low.farther > low.limit {
            found.push(event(EventKind::Least { column, value: low.limit }));
        }
        found
    }
}

impl Sweep {
    /// Corrects what is extreme where forces leap: the walk sees a force that goes on at such a place, whose slope may vanish
    /// on one side of it.
    pub(super) fn mend_extremes(&mut self) {
        let whole = self.range[1] - self.range[0];
        let mut events = std::mem::take(&mut self.events);
        for reversal in &self.reversals {
            for &measure in &self.measures {
                let Some(sides) = reversal.leap(measure) else { continue };
                events.retain(|event| {
                    let (EventKind::Least { column, .. } | EventKind::Greatest { column, .. }) = event.kind
                    else {
                        return true;
                    };
                    let away = (event.at - reversal.at).abs();
                    let away = if self.whole_turn { away.min(whole - away) } else { away };
                    column != measure.first() || away > 2.0 * BESIDE * whole
                });
                if self.is_told(measure.first(), reversal.at) {
                    events.extend(reversal.extremes(measure, &sides));
                }
            }
        }
        events.sort_by(|a, b| a.at.total_cmp(&b.at));
        self.events = events;
    }
}

/// Every reversal in the range of a sweep, ascending; none of a sweep over time.
pub(super) fn reversals(
    mechanism: &Mechanism,
    sweep: &Sweep,
    over: Over,
    stated: Option<[f64; 2]>,
) -> Vec<Reversal> {
    let watched = watched(mechanism);
    if watched.is_empty() || over == Over::Time {
        return Vec::new();
    }
    let mut motion = mechanism.clone();
    motion.forces.friction = Friction::default();
    motion.forces.loads.retain(|load| !load.follows_motion());
    motion.asked = watched.iter().map(|(_, quantity)| asked(mechanism, *quantity)).collect();
    let Ok(motion) = Sweep::over(over, &motion, stated) else { return Vec::new() };
    let [from, to] = sweep.range;
    let whole = to - from;
    let wrapped = |at: f64| {
        if !sweep.whole_turn || (from..=to).contains(&at) {
            return at;
        }
        at - libm::floor((at - from) / whole) * whole
    };
    // A rate or the coordinates of a velocity; none where the mechanism does not stand.
    let look = |at: f64, of: usize| -> Option<Vec<f64>> {
        let numbers = motion.at(wrapped(at))?;
        let own = motion
            .columns
            .iter()
            .zip(&numbers)
            .filter(|(column, _)| !column.watched && column.asked.quantity == watched[of].1);
        own.map(|(_, number)| number.as_ref().map(|number| number.value)).collect()
    };
    let against = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() < 0.0;
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let place = |index: usize| from + whole * (index as f64 + 0.5) / LOOKS as f64;
    let mut found: Vec<Reversal> = Vec::new();
    for (of, (name, _)) in watched.iter().enumerate() {
        let last = if sweep.whole_turn { LOOKS } else { LOOKS - 1 };
        for index in 0..last {
            let [mut low, mut high] = [place(index), place(index + 1)];
            let (Some(start), Some(end)) = (look(low, of), look(high, of)) else { continue };
            if !against(&start, &end) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(low, high);
                match look(middle, of) {
                    Some(here) if against(&start, &here) => high = middle,
                    Some(_) => low = middle,
                    None => break,
                }
            }
            let at = wrapped(f64::midpoint(low, high));
            // What nobody is to see as another place.
            let near = |other: &&mut Reversal| (other.at - at).abs() <= BESIDE * whole;
            match found.iter_mut().find(near) {
                Some(other) => other.what.push(name.clone()),
                None => {
                    let [before, after] =
                        [-1.0, 1.0].map(|sign| side(sweep, at, sign * BESIDE * whole, &wrapped));
                    let (sides, beside) = ([before.0, after.0], [before.1, after.1]);
                    found.push(Reversal { at, what: vec![name.clone()], sides, beside });
                }
            }
        }
    }
    found.sort_by(|a, b| a.at.total_cmp(&b.at));
    found
}

/// What motions forces hang on, with the names by which they are told.
fn watched(mechanism: &Mechanism) -> Vec<(String, Quantity)> {
    let number = |link: LinkId| mechanism.link(link).number;
    let turning = |link: LinkId, carrier: LinkId| match carrier {
        LinkId::FRAME => Quantity::Omega(link),
        _ => Quantity::RelativeOmega(link, carrier),
    };
    let mut all: Vec<(String, Quantity)> = Vec::new();
    for pair in mechanism.rubbing_pairs() {
        match pair {
            RubbingPair::Pin { pin, carrier, link } => {
                let name = format!(
                    "link {} on link {} at {}",
                    number(link),
                    number(carrier),
                    mechanism.point(pin).name
                );
                all.push((name, turning(link, carrier)));
            }
            RubbingPair::Slide(slide) => {
                let guide = mechanism.slides[slide].guide.link;
                let Some(point) = mechanism.pin_of_slide(slide) else { continue };
                let quantity = match guide {
                    LinkId::FRAME => Quantity::Velocity(point),
                    _ => Quantity::Slip(point, guide),
                };
                all.push((format!("{} in its guide", mechanism.point(point).name), quantity));
            }
        }
    }
    for load in mechanism.forces.loads.iter().filter(|load| load.follows_motion()) {
        let quantity = match load.kind {
            LoadKind::Force { at, .. } | LoadKind::Vector { at, .. } => Quantity::Velocity(at),
            LoadKind::Torque { .. } => Quantity::Omega(load.link),
        };
        all.push((format!("the motion that {} follows", load.name), quantity));
    }
    all
}

fn asked(mechanism: &Mechanism, quantity: Quantity) -> Asked {
    let unit = Unit { symbol: String::new(), si: 1.0 };
    Asked { name: quantity.name(mechanism), quantity, unit, method: Method::default() }
}

/// The columns on one side of a place, on along a straight line through two places beside it, and those at the farther of the
/// two.
fn side(
    sweep: &Sweep,
    at: f64,
    step: f64,
    wrapped: &dyn Fn(f64) -> f64,
) -> (Vec<Option<f64>>, Vec<Option<f64>>) {
    let near = |times: f64| sweep.at(wrapped(at + times * step));
    let nowhere = || vec![None; sweep.columns.len()];
    let (Some(one), Some(two)) = (near(1.0), near(2.0)) else { return (nowhere(), nowhere()) };
    let limits = one.iter().zip(&two).map(|(one, two)| Some(2.0 * one.as_ref()?.value - two.as_ref()?.value));
    (limits.collect(), two.iter().map(|two| two.as_ref().map(|two| two.value)).collect())
}
