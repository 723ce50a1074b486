//! Where in a sweep something that rubs, or a load against a motion, turns round: forces leap there, and both sides are
//! told.

use crate::mechanism::force::LoadKind;
use crate::mechanism::friction::{Friction, RubbingPair};
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::mechanism::{LinkId, Mechanism};
use crate::sweep::{Over, Sweep};

/// So many places of the range are looked at.
const LOOKS: usize = 720;
/// So often the way between two of them is halved.
const HALVINGS: usize = 60;
/// So far beside a reversal, as a part of the range, the forces of its sides are looked at.
const BESIDE: f64 = 1e-6;

/// A place at which motion turns round.
#[derive(Debug, Clone)]
pub(super) struct Reversal {
    /// The input, SI.
    pub(super) at: f64,
    /// What turns round there.
    pub(super) what: Vec<String>,
    /// The columns before and after it, SI; none where there is no balance.
    pub(super) sides: [Vec<Option<f64>>; 2],
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
    // A rate or a velocity; none where the mechanism does not stand.
    let look = |at: f64, of: usize| -> Option<[f64; 2]> {
        let numbers = motion.at(wrapped(at))?;
        let own = motion
            .columns
            .iter()
            .zip(&numbers)
            .filter(|(column, _)| !column.watched && column.asked.quantity == watched[of].1);
        let mut own = own.map(|(_, number)| number.map(|number| number.value));
        let first = own.next()??;
        Some([first, own.next().flatten().unwrap_or(0.0)])
    };
    let against = |a: [f64; 2], b: [f64; 2]| a[0] * b[0] + a[1] * b[1] < 0.0;
    #[expect(clippy::cast_precision_loss, reason = "a few hundred")]
    let place = |index: usize| from + whole * (index as f64 + 0.5) / LOOKS as f64;
    let mut found: Vec<Reversal> = Vec::new();
    for (of, (name, _)) in watched.iter().enumerate() {
        let last = if sweep.whole_turn { LOOKS } else { LOOKS - 1 };
        for index in 0..last {
            let [mut low, mut high] = [place(index), place(index + 1)];
            let (Some(start), Some(end)) = (look(low, of), look(high, of)) else { continue };
            if !against(start, end) {
                continue;
            }
            for _ in 0..HALVINGS {
                let middle = f64::midpoint(low, high);
                match look(middle, of) {
                    Some(here) if against(start, here) => high = middle,
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
                    let side = |sign: f64| side(sweep, at, sign * BESIDE * whole, &wrapped);
                    found.push(Reversal { at, what: vec![name.clone()], sides: [side(-1.0), side(1.0)] });
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

/// The columns on one side of a place, on along a straight line through two places beside it.
fn side(sweep: &Sweep, at: f64, step: f64, wrapped: &dyn Fn(f64) -> f64) -> Vec<Option<f64>> {
    let near = |times: f64| sweep.at(wrapped(at + times * step));
    let (Some(one), Some(two)) = (near(1.0), near(2.0)) else { return vec![None; sweep.columns.len()] };
    one.into_iter().zip(two).map(|(one, two)| Some(2.0 * one?.value - two?.value)).collect()
}
