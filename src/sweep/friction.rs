//! Where along a sweep more than one balance with friction fits.
//!
//! A sweep runs the passes of one drawing, and these come to an end at one balance; that another one fits besides only
//! scratch paper tells ([`crate::graphical::holds`]), which is too slow for every position. Near a limit or a dead position
//! friction turns lines about that meet at ever flatter angles: from there outwards it is looked for, until one balance is
//! left.

use super::course::seam;
use super::{EventKind, Sweep};
use crate::graphical;
use crate::mechanism::quantity::{Quantity, Stuck};
use crate::mechanism::structure::Structure;
use crate::plan::{Extent, Plan};

/// The first look beside a limit or a dead position, in parts of the range.
const BESIDE: f64 = 1e-4;

/// The next look is so many times as far from there.
const FARTHER: f64 = 4.0;

/// Looks by halves between the last place where two balances fit and the first one where they do not; each costs as much as
/// some hundred positions of a sweep. What is left between the last two of them is left out as well.
const HALVINGS: u32 = 5;

impl Sweep {
    /// Whether two balances with friction fit at a place.
    fn several_fit(&self, at: f64) -> bool {
        let Some(mechanism) = self.mechanism_at(at) else { return false };
        let Ok(structure) = Structure::of(&mechanism) else { return false };
        let plan = Plan::new(&mechanism, &structure, Extent::Asked);
        matches!(graphical::holds((&mechanism, &structure, &plan)), Some((Stuck::Ambiguous, _)))
    }

    /// The parts of the range next to limits and dead positions in which two balances fit, ascending.
    pub(super) fn several_balances(&self) -> Vec<[f64; 2]> {
        let asks = self.columns.iter().any(|column| matches!(column.asked.quantity, Quantity::Force(..)));
        if !asks || self.placed.forces.friction.is_empty() {
            return Vec::new();
        }
        let ends = self.events.iter().filter(|event| {
            matches!(event.kind, EventKind::Limit | EventKind::DeadPosition | EventKind::ChangePoint)
        });
        let mut ends: Vec<f64> = ends.map(|event| event.at).collect();
        // What happens at several places within the first look happens at one.
        let beside = BESIDE * (self.range[1] - self.range[0]);
        ends.dedup_by(|next, last| *next - *last <= beside.max(seam(self)));
        let mut found: Vec<[f64; 2]> = Vec::new();
        for (index, &end) in ends.iter().enumerate() {
            let up = ends.get(index + 1).map_or(self.range[1], |next| f64::midpoint(end, *next));
            let down = match index {
                0 => self.range[0],
                index => f64::midpoint(end, ends[index - 1]),
            };
            for farthest in [down, up] {
                found.extend(self.several_from(end, farthest).map(|to| [end.min(to), end.max(to)]));
            }
        }
        found
    }

    /// As far as which place two balances fit, from one towards another; none where only one fits beside it.
    fn several_from(&self, end: f64, farthest: f64) -> Option<f64> {
        let way = farthest - end;
        let mut first = BESIDE * (self.range[1] - self.range[0]) / way.abs();
        let moves = |at: f64| self.stretch_at(at).is_some();
        if first.is_nan() || first >= 1.0 || !moves(end + first * way) || !self.several_fit(end + first * way)
        {
            return None;
        }
        let mut one = 1.0;
        while first < 1.0 {
            let next = (FARTHER * first).min(1.0);
            if !self.several_fit(end + next * way) {
                one = next;
                break;
            }
            first = next;
        }
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(first, one);
            if self.several_fit(end + middle * way) { first = middle } else { one = middle }
        }
        Some(end + one * way)
    }

    /// Whether a place lies where two balances fit: no force is told there.
    #[must_use]
    pub fn is_ambiguous(&self, at: f64) -> bool {
        self.ambiguous.iter().any(|[from, to]| (*from..=*to).contains(&at))
    }
}
