//! Bounds of the results of a tape, from what is known when they are asked for.
//!
//! One sweep back from an asked result adds up what every rounding and every uncertain number of the scene does to it,
//! *with* the correlations that running error bounds lose: a chain of twenty dyads keeps its digits.
//!
//! The bound is no estimate of first order. Let a result be computed as x̂ₖ = f(x̂) + δₖ, and let eₖ be the error
//! that it has. Then eₖ = Σ ∂f(x̂)·e + δₖ − ρₖ, where ρₖ is what the errors of the operands do to f beyond its
//! tangent: eₐ·e_b for a product, the quotient's own error times the divisor's relative one, and so on. These
//! equations are linear in e, so that the sweep back solves them without neglect: the error of the answer is
//! Σ ∂answer/∂xₖ·(δₖ − ρₖ), and its bound the sum of the sizes. A bound of ρₖ needs only rough bounds of the
//! operands' errors, since it is of second order in them: running ones, drawn in by sweeps of their own where
//! they are too rough for that. All of this is done when somebody asks, operation by operation up to where he asks.

use super::op::{Beyond, MOST_OPERANDS, OF_PARTIALS, Op};
use super::scalar::{Arithmetic, Real};
use super::sketch::Sketches;
use super::tape::{Entry, Errors, Event, Node, Reason, Role, Tape};
use super::waiting::Waiting;
use crate::double_double::DoubleDouble;
use crate::wide::Wide;

/// What is known of the error of a result.
#[derive(Debug, Clone, Copy)]
struct Slot {
    /// The partial derivatives by its operands.
    partials: [f64; MOST_OPERANDS],
    /// What this operation adds to the error: its rounding, and what the tangent leaves out of it.
    own: f64,
    /// How much of it the tangent leaves out.
    left_out: f64,
    /// The error is no larger; without the correlations often much smaller.
    error: f64,
    /// How far the point of which it is a coordinate lies from the origin, where it is one that was drawn.
    point: Option<f64>,
    drawn_in: DrawnIn,
}

impl Slot {
    /// Whether sweeps may end here: a coordinate of a point that is drawn in so far, or so fine that what its
    /// correlations are worth does not matter.
    fn is_end(&self, sweep: DrawnIn) -> bool {
        match (self.point, sweep) {
            (None, _) | (_, DrawnIn::ToWholePoints | DrawnIn::Wholly) => false,
            (_, DrawnIn::Not | DrawnIn::ToPoints) => self.drawn_in > DrawnIn::Not,
            (Some(size), DrawnIn::ToExactPoints) => self.drawn_in >= sweep || self.error <= FINE * size,
        }
    }
}

/// How far the error of a slot has been drawn in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum DrawnIn {
    /// It is a running error.
    Not,
    /// From the nearest points behind it, whose errors are drawn in by sweeps that end at points drawn in before.
    ToPoints,
    /// From the nearest points behind it, whose errors are drawn in by sweeps that end at points for which that was done
    /// before, and at fine ones.
    ToExactPoints,
    /// From the nearest points behind it, whose errors are drawn in by sweeps through the whole tape.
    ToWholePoints,
    /// By a sweep of its own through the whole tape.
    Wholly,
}

/// A divisor that does not exceed its error.
#[derive(Debug, Clone, Copy)]
struct WeakDivisor {
    slot: u32,
    reason: Reason,
}

/// The bounds of a tape, as far as somebody has asked.
#[derive(Debug, Clone, Default)]
pub(super) struct Bounds {
    slots: Vec<Slot>,
    /// How many events of the tape have been looked at.
    events: usize,
    weak: Vec<WeakDivisor>,
    adjoint: Vec<[f64; 1]>,
    reached: Vec<u8>,
    /// Scratch of local sweeps: zero between them.
    local: Vec<f64>,
    /// Scratch of sweeps from many results: zero between them.
    lanes: Vec<[f64; LANES]>,
    /// Rough errors of a long tape.
    sketches: Sketches,
    /// A result has asked for every sweep that is worth it.
    is_thorough: bool,
    /// The slots that a local sweep has still to look at; none between sweeps.
    waiting: Waiting,
}

/// A way to draw operands in, and when it is worth it.
#[derive(Debug, Clone, Copy)]
struct Sweep {
    how: DrawnIn,
    /// What the tangent leaves out is more than so much of a rounding,
    of_rounding: f64,
    /// and, where nothing can be rounded, than this part of what the operands' errors do along the tangent;
    of_error: f64,
    /// or these are more than this part of the terms themselves: for that no sweep goes through the whole tape, since what
    /// is zero but for its roundings gains nothing by it.
    of_terms: f64,
}

/// How operands are drawn in, one sweep after the other as long as it is worth it. Running errors may be too rough to
/// measure anything by; the longer the sweep, the more must depend on it.
const SWEEPS: [Sweep; 4] = [
    Sweep { how: DrawnIn::ToPoints, of_rounding: 1.0 / 64.0, of_error: 1e-9, of_terms: 1.0 / 256.0 },
    Sweep { how: DrawnIn::ToExactPoints, of_rounding: 1.0, of_error: 1e-8, of_terms: 1.0 / 64.0 },
    Sweep { how: DrawnIn::ToWholePoints, of_rounding: 1.0, of_error: 1e-8, of_terms: f64::INFINITY },
    Sweep { how: DrawnIn::Wholly, of_rounding: 8.0, of_error: 1e-6, of_terms: f64::INFINITY },
];

impl Sweep {
    /// Whether what the errors of an operation's operands do to it is worth this sweep; `least` is its rounding, `terms` the
    /// sum of the sizes of its terms.
    fn matters(&self, beyond: &Beyond, along: f64, least: f64, terms: f64) -> bool {
        let of_error = if least > 0.0 && self.how < DrawnIn::Wholly { 0.0 } else { self.of_error };
        beyond.left_out > self.of_rounding * least + of_error * along
            || along > self.of_terms * terms && terms > 0.0
    }
}

/// Whether running errors may be too rough to measure anything by.
fn is_rough(beyond: &Beyond, along: f64, least: f64, terms: f64) -> bool {
    beyond.left_out > SWEEPS[0].of_rounding * least || along > SWEEPS[0].of_terms * terms
}

/// What the errors of the operands do to a result along the tangent.
#[inline(always)]
fn along_tangent(partials: &[f64; MOST_OPERANDS], errors: &[f64; MOST_OPERANDS]) -> f64 {
    let mut along = 0.0;
    for k in 0..MOST_OPERANDS {
        // What does not move it may err without bound.
        along += if partials[k] == 0.0 { 0.0 } else { partials[k].abs() * errors[k] };
    }
    along
}

/// The rounding of an operation, and the unit roundoff, of another arithmetic than doubles.
#[inline(never)]
fn rounding_in(arithmetic: Arithmetic, op: Op, at: [f64; MOST_OPERANDS], value: f64) -> (f64, f64) {
    match arithmetic {
        Arithmetic::Single => (op.rounding::<f32>(at, value), f32::UNIT_ROUNDOFF),
        Arithmetic::Double => (op.rounding::<f64>(at, value), f64::UNIT_ROUNDOFF),
        Arithmetic::DoubleDouble => (op.rounding::<DoubleDouble>(at, value), DoubleDouble::UNIT_ROUNDOFF),
        Arithmetic::Wide => (op.rounding::<Wide>(at, value), Wide::UNIT_ROUNDOFF),
    }
}

/// From so many operations on the errors of operands are sketched before a sweep goes back for them: the sweeps of a
/// longer tape would cost more with each operation.
const LONG: usize = 4096;

/// What the tangents leave out of a long tape is looked at more closely when it is more than this part of the error of a
/// result. Most of it concerns what is zero but for its roundings, and never arrives anywhere.
const OF_LEFT_OUT: f64 = 1.0 / 4.0;

/// Errors that are no more than this part of a point's distance from the origin are fine: nothing that follows from
/// such errors is drawn in because of them.
const FINE: f64 = 1e-12;

/// A divisor is too weak to divide by when its error passes this part of it.
pub(super) const WEAK_DIVISOR: f64 = 1.0 / 8.0;

/// The bound is itself computed in doubles.
pub(super) const ROUNDED: f64 = 1e-9;

/// Sweeps go back from so many results at once, a bit of a byte for each.
const LANES: usize = u8::BITS as usize;

/// What a sweep back tells of a result.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Judged {
    /// |value − truth| ≤ bound, unless there is a weakness.
    pub bound: f64,
    /// The reason of the first divisor behind the result that does not exceed its own error eightfold.
    pub weakness: Option<Reason>,
}

impl Tape {
    /// Bound of a recorded result: |value − truth| ≤ bound, unless [`Tape::weakness`] says that it has
    /// none.
    pub fn bound(&mut self, mark: u32) -> f64 {
        (1.0 + ROUNDED) * self.total_error(mark)
    }

    /// A bound that is at hand and often much larger than [`Tape::bound`], since it knows no correlations.
    #[must_use]
    pub fn rough_bound(&mut self, mark: u32) -> f64 {
        self.evaluate();
        (1.0 + ROUNDED) * self.error_of(mark)
    }

    /// A bound between that and [`Tape::bound`], from the nearest points behind the result.
    #[must_use]
    pub fn nearer_bound(&mut self, mark: u32) -> f64 {
        self.evaluate();
        self.draw_in(mark, DrawnIn::ToPoints);
        (1.0 + ROUNDED) * self.error_of(mark)
    }

    /// The part of [`Tape::bound`] that the numbers of the scene bring with them, each known to half a unit in its
    /// last place: no drawing can do better. In unit roundoffs, the conditioning of the result.
    pub fn inherited(&mut self, mark: u32) -> f64 {
        self.sweep_back(mark);
        let slots = self.bounds.adjoint.iter().zip(&self.bounds.slots).zip(&self.nodes);
        let given = slots.filter(|((_, slot), node)| matches!(node.node(), Node::Leaf(_)) && slot.own > 0.0);
        given.map(|(([adjoint], slot), _)| adjoint.abs() * slot.own).sum()
    }

    /// [`Tape::bound`] and [`Tape::weakness`] of many results: eight of them cost little more than one.
    pub fn judged(&mut self, marks: &[u32]) -> Vec<Judged> {
        self.evaluate();
        let (judged, is_rough) = self.judged_as_followed(marks);
        if !is_rough {
            return judged;
        }
        self.follow_thoroughly();
        self.judged_as_followed(marks).0
    }

    /// The same as the tape was followed, and whether it has to be followed thoroughly.
    fn judged_as_followed(&mut self, marks: &[u32]) -> (Vec<Judged>, bool) {
        let mut is_rough = false;
        // What stands near to each other on the tape leads back to the same slots.
        let mut order: Vec<usize> = (0..marks.len()).collect();
        order.sort_by_key(|index| marks[*index]);
        let mut judged = vec![Judged { bound: 0.0, weakness: None }; marks.len()];
        for at_once in order.chunks(LANES) {
            let results: Vec<u32> = at_once.iter().map(|index| marks[*index]).collect();
            // Lanes without a result would cost as much as the others.
            let [errors, left_out] = match results.len() {
                1 => self.swept_errors::<1>(&results),
                2 => self.swept_errors::<2>(&results),
                3 | 4 => self.swept_errors::<4>(&results),
                _ => self.swept_errors::<LANES>(&results),
            };
            let Bounds { reached, weak, .. } = &self.bounds;
            for (lane, index) in at_once.iter().enumerate() {
                let leads = |slot: u32| reached.get(slot as usize).is_some_and(|to| to & (1 << lane) != 0);
                judged[*index].weakness = weak.iter().find(|d| leads(d.slot)).map(|d| d.reason);
            }
            for (lane, index) in at_once.iter().enumerate() {
                let judged = &mut judged[*index];
                judged.bound = (1.0 + ROUNDED) * errors[lane];
                is_rough |= self.is_rough(errors[lane], left_out[lane], judged.weakness);
            }
        }
        (judged, is_rough)
    }

    /// The errors of some results, each in a lane, and how much of them the tangents left out; `reached` tells afterwards
    /// what leads to which.
    fn swept_errors<const N: usize>(&mut self, results: &[u32]) -> [[f64; LANES]; 2] {
        let Self { nodes, bounds, .. } = self;
        let Bounds { slots, lanes, reached, .. } = bounds;
        let (mut errors, mut left_out) = ([0.0; LANES], [0.0; LANES]);
        sweep(nodes, slots, results, in_lanes::<N>(lanes, slots.len()), reached, |slot, adjoints| {
            // What does not lead to the result may err without bound.
            for (lane, adjoint) in std::mem::replace(adjoints, [0.0; N]).into_iter().enumerate() {
                errors[lane] += if adjoint == 0.0 { 0.0 } else { adjoint.abs() * slot.own };
                left_out[lane] += if adjoint == 0.0 { 0.0 } else { adjoint.abs() * slot.left_out };
            }
        });
        [errors, left_out]
    }

    /// The reason of the first divisor behind this result that does not exceed its own error eightfold.
    pub fn weakness(&mut self, mark: u32) -> Option<Reason> {
        self.evaluate();
        let weakness = self.weakness_as_followed(mark);
        if !self.is_rough(0.0, 0.0, weakness) {
            return weakness;
        }
        self.follow_thoroughly();
        self.weakness_as_followed(mark)
    }

    fn weakness_as_followed(&mut self, mark: u32) -> Option<Reason> {
        if self.bounds.weak.is_empty() {
            return None;
        }
        self.sweep_back(mark);
        let reached = &self.bounds.reached;
        let is_behind = |d: &&WeakDivisor| reached.get(d.slot as usize).is_some_and(|to| *to != 0);
        self.bounds.weak.iter().find(is_behind).map(|d| d.reason)
    }

    /// ∂(result)/∂(slot): how the result moves when the slot is moved alone.
    pub fn sensitivity(&mut self, mark: u32, slot: u32) -> f64 {
        self.sweep_back(mark);
        self.bounds.adjoint.get(slot as usize).map_or(0.0, |[adjoint]| *adjoint)
    }

    /// What all slots together can do to a result.
    pub(super) fn total_error(&mut self, mark: u32) -> f64 {
        self.sweep_back(mark);
        let [error, left_out] = self.swept_error();
        if !self.is_rough(error, left_out, None) {
            return error;
        }
        self.follow_thoroughly();
        self.sweep_back(mark);
        self.swept_error()[0]
    }

    /// The error of a result from which a sweep has come back, and how much of it the tangents left out.
    fn swept_error(&self) -> [f64; 2] {
        // What does not lead to the result may err without bound.
        let slots = self.bounds.adjoint.iter().zip(&self.bounds.slots);
        // In the order of a sweep back.
        let moves = slots.rev().filter(|([adjoint], _)| *adjoint != 0.0);
        moves.fold([0.0; 2], |[error, left_out], ([adjoint], slot)| {
            [error + adjoint.abs() * slot.own, left_out + adjoint.abs() * slot.left_out]
        })
    }

    /// What all slips of the hand together can do to a result, to first order.
    pub fn worst(&mut self, mark: u32) -> f64 {
        self.total_error(mark)
    }

    // --- operation by operation ----------------------------------------------------------------

    /// Follows the tape to its end.
    fn evaluate(&mut self) {
        self.bounds.slots.reserve(self.nodes.len() - self.bounds.slots.len());
        for index in self.bounds.slots.len()..self.nodes.len() {
            self.look_at_events(index);
            match self.nodes[index].node() {
                Node::Leaf(leaf) => {
                    let own = self.leaf_error(leaf);
                    self.push([0.0; MOST_OPERANDS], own, own, 0.0);
                }
                Node::Made(op, of) => self.follow(index, op, of),
            }
        }
        self.look_at_events(self.nodes.len());
    }

    fn leaf_error(&self, leaf: u32) -> f64 {
        let Some(leaf) = self.leaves.get(leaf as usize) else { return f64::INFINITY };
        match self.errors {
            Errors::Slips(_) if leaf.role != Role::Slip => 0.0,
            _ => leaf.error,
        }
    }

    #[inline(always)]
    fn push(&mut self, partials: [f64; MOST_OPERANDS], own: f64, error: f64, left_out: f64) {
        self.bounds.slots.push(Slot { partials, own, left_out, error, point: None, drawn_in: DrawnIn::Not });
    }

    fn look_at_events(&mut self, before: usize) {
        while let Some(&(at, event)) = self.events.get(self.bounds.events) {
            if at as usize > before {
                return;
            }
            self.bounds.events += 1;
            match event {
                Event::Point(marks) => {
                    let [x, y] = marks.map(|mark| self.values.get(mark as usize).copied().unwrap_or(0.0));
                    for mark in marks {
                        if let Some(slot) = self.bounds.slots.get_mut(mark as usize) {
                            slot.point = Some(libm::hypot(x, y));
                        }
                    }
                }
                Event::Divisor { slot, value, reason } => self.judge(slot, value, reason),
            }
        }
    }

    fn judge(&mut self, mark: u32, value: f64, reason: Reason) {
        // Written so that a not-a-number counts as weak, and a zero that has no error.
        let clear = |tape: &Self| tape.error_of(mark) < WEAK_DIVISOR * value.abs();
        if value != 0.0 && !clear(self) {
            self.sketch(&[mark]);
        }
        for sweep in SWEEPS.into_iter().filter(|_| value != 0.0) {
            if !clear(self) {
                self.draw_in(mark, sweep.how);
            }
        }
        if !clear(self) {
            self.bounds.weak.push(WeakDivisor { slot: mark, reason });
        }
    }

    #[inline(always)]
    fn follow(&mut self, index: usize, op: Op, of: [u32; MOST_OPERANDS]) {
        // As many rounds for every operation, so that the compiler unrolls them.
        let (mut at, mut errors) = ([0.0; MOST_OPERANDS], [0.0; MOST_OPERANDS]);
        for k in 0..MOST_OPERANDS {
            if k < op.operands() {
                at[k] = self.values.get(of[k] as usize).copied().unwrap_or(0.0);
                errors[k] = self.error_of(of[k]);
            }
        }
        let value = self.values[index];
        let partials = op.partials(at, value);
        let mut along = along_tangent(&partials, &errors);
        if self.errors != Errors::Roundings {
            return self.push(partials, 0.0, along, 0.0);
        }
        let (rounding, unit) = match self.arithmetic {
            Arithmetic::Double => (op.rounding::<f64>(at, value), f64::UNIT_ROUNDOFF),
            other => rounding_in(other, op, at, value),
        };
        let mut beyond = op.beyond(&at, &partials, &errors, along);
        // Products with powers of two are exact, and beside exact numbers nothing is too small to matter.
        let mut terms = 0.0;
        for k in 0..MOST_OPERANDS {
            terms += (partials[k] * at[k]).abs();
        }
        let least = rounding.max(unit * terms);
        if is_rough(&beyond, along, least, terms) || SWEEPS[0].matters(&beyond, along, least, terms) {
            (along, beyond) = self.drawn_in((index, op, of), &at, &partials, [least, terms], (along, beyond));
        }
        let left_out = beyond.left_out;
        if beyond.has_tangent {
            let own = rounding + left_out + OF_PARTIALS * along;
            self.push(partials, own, own + along, left_out);
        } else {
            let own = rounding + left_out;
            self.push([0.0; MOST_OPERANDS], own, own, left_out);
        }
    }

    /// Draws in the operands of an operation, as far as it is worth it: what their errors do to it then, along the tangent
    /// and beyond it. `least` is its rounding, `terms` the sum of the sizes of its terms.
    #[inline(never)]
    fn drawn_in(
        &mut self,
        (index, op, of): (usize, Op, [u32; MOST_OPERANDS]),
        at: &[f64; MOST_OPERANDS],
        partials: &[f64; MOST_OPERANDS],
        [least, terms]: [f64; 2],
        (mut along, mut beyond): (f64, Beyond),
    ) -> (f64, Beyond) {
        // What was only measured to see that the drawing is right needs no good bound.
        if self.is_aside(index) {
            return (along, beyond);
        }
        let of = &of[..op.operands()];
        let again = |tape: &Self| {
            let mut errors = [0.0; MOST_OPERANDS];
            for (error, &mark) in errors.iter_mut().zip(of) {
                *error = tape.error_of(mark);
            }
            let along = along_tangent(partials, &errors);
            (along, op.beyond(at, partials, &errors, along))
        };
        if is_rough(&beyond, along, least, terms) && self.sketch(of) {
            (along, beyond) = again(self);
        }
        for sweep in SWEEPS {
            let matters = sweep.matters(&beyond, along, least, terms);
            if !matters || beyond.left_out.is_infinite() || !self.may_sweep(index, sweep.how) {
                break;
            }
            for &mark in of {
                self.draw_in(mark, sweep.how);
            }
            (along, beyond) = again(self);
        }
        (along, beyond)
    }

    /// Whether a sweep may go back for the operands of an operation: of a long tape none goes through the whole before a
    /// result has asked for it.
    fn may_sweep(&self, index: usize, how: DrawnIn) -> bool {
        index < LONG || how < DrawnIn::ToWholePoints || self.bounds.is_thorough
    }

    /// Follows the tape once more, with every sweep that is worth it: a result is off by what was left out of a long tape
    /// without them, or divided by what they may tell from zero.
    fn follow_thoroughly(&mut self) {
        self.bounds = Bounds { is_thorough: true, ..Bounds::default() };
        self.evaluate();
    }

    /// Whether a long tape that was not followed thoroughly leaves a result worse than it needs to be: much of its error
    /// is what the tangents left out, or a divisor behind it seems too weak.
    fn is_rough(&self, error: f64, left_out: f64, weakness: Option<Reason>) -> bool {
        let is_short_of = left_out > OF_LEFT_OUT * error || weakness.is_some();
        !self.bounds.is_thorough && self.nodes.len() > LONG && is_short_of
    }

    /// A bound of the error of a slot.
    fn error_of(&self, mark: u32) -> f64 {
        self.bounds.slots.get(mark as usize).map_or(f64::INFINITY, |slot| slot.error)
    }

    /// What the errors of the operands do to a result along the tangent.
    fn along(&self, partials: &[f64; MOST_OPERANDS], of: &[u32]) -> f64 {
        // What does not move it may err without bound.
        let passed_on =
            |partial: f64, mark: u32| if partial == 0.0 { 0.0 } else { partial.abs() * self.error_of(mark) };
        partials.iter().zip(of).map(|(&partial, &mark)| passed_on(partial, mark)).sum()
    }

    // --- sweeps --------------------------------------------------------------------------------

    /// Draws in the errors of some slots of a long tape as far as a sketch can; whether it was asked.
    fn sketch(&mut self, marks: &[u32]) -> bool {
        let Self { nodes, bounds: Bounds { slots, sketches, .. }, .. } = self;
        if slots.len() < LONG {
            return false;
        }
        for index in sketches.len()..slots.len() {
            let slot = &slots[index];
            sketches.push(slot.own, nodes[index].operands().iter().zip(slot.partials));
        }
        for &mark in marks {
            if let Some(slot) = slots.get_mut(mark as usize) {
                slot.error = slot.error.min(sketches.error_of(mark));
            }
        }
        true
    }

    /// Draws in the error of a slot, as far as this sweep can.
    ///
    /// Where the nearest points behind it are drawn in by sweeps that end at points drawn in before, the
    /// correlations within some ten groups count, and a long chain costs no more for each of its links than a
    /// short one.
    fn draw_in(&mut self, mark: u32, sweep: DrawnIn) {
        let slot = self.bounds.slots.get(mark as usize).filter(|slot| slot.drawn_in < sweep);
        let Some(slot) = slot else { return };
        let nothing = slot.error == 0.0;
        if nothing || sweep == DrawnIn::Wholly {
            let error = if nothing { 0.0 } else { self.errors_behind(&[mark])[0] };
            self.set_drawn_in(mark, error, sweep);
            return;
        }
        let (mut points, mut between) = (Vec::new(), Vec::new());
        let Self { nodes, bounds: Bounds { slots, waiting, .. }, .. } = self;
        waiting.add(mark);
        while let Some(index) = waiting.take_last() {
            let slot = &slots[index as usize];
            if slot.drawn_in >= sweep || sweep > DrawnIn::ToPoints && index != mark && slot.is_end(sweep) {
                continue;
            }
            if slot.point.is_some() {
                points.push(index);
            } else {
                between.push(index);
                nodes[index as usize].operands().iter().for_each(|&operand| waiting.add(operand));
            }
        }
        points.reverse();
        if sweep <= DrawnIn::ToExactPoints {
            for point in points {
                let error = self.error_behind(point, sweep);
                self.set_drawn_in(point, error, sweep);
            }
        } else {
            for at_once in points.chunks(LANES) {
                let errors = self.errors_behind(at_once);
                for (&point, error) in at_once.iter().zip(errors) {
                    self.set_drawn_in(point, error, sweep);
                }
            }
        }
        for &index in between.iter().rev() {
            let slot = &self.bounds.slots[index as usize];
            let error = slot.own + self.along(&slot.partials, self.nodes[index as usize].operands());
            self.set_drawn_in(index, error, sweep);
        }
    }

    fn set_drawn_in(&mut self, mark: u32, error: f64, sweep: DrawnIn) {
        if let Some(slot) = self.bounds.slots.get_mut(mark as usize) {
            slot.error = slot.error.min(error);
            slot.drawn_in = sweep;
        }
    }

    /// A bound of the error of a slot, by a sweep back that ends at points.
    fn error_behind(&mut self, mark: u32, sweep: DrawnIn) -> f64 {
        let Self { nodes, bounds, .. } = self;
        let Bounds { slots, local, waiting, .. } = bounds;
        local.resize(slots.len(), 0.0);
        local[mark as usize] = 1.0;
        waiting.add(mark);
        let mut error = 0.0;
        while let Some(index) = waiting.take_last() {
            let adjoint = std::mem::take(&mut local[index as usize]);
            if adjoint == 0.0 {
                continue;
            }
            let slot = &slots[index as usize];
            if index != mark && slot.is_end(sweep) {
                error += adjoint.abs() * slot.error;
                continue;
            }
            error += adjoint.abs() * slot.own;
            for (&part, partial) in nodes[index as usize].operands().iter().zip(slot.partials) {
                local[part as usize] += adjoint * partial;
                waiting.add(part);
            }
        }
        error
    }

    /// The same of some slots, by one sweep through the whole tape.
    fn errors_behind(&mut self, marks: &[u32]) -> [f64; LANES] {
        match marks.len() {
            1 => self.errors_in_lanes::<1>(marks),
            2 => self.errors_in_lanes::<2>(marks),
            3 | 4 => self.errors_in_lanes::<4>(marks),
            _ => self.errors_in_lanes::<LANES>(marks),
        }
    }

    fn errors_in_lanes<const N: usize>(&mut self, marks: &[u32]) -> [f64; LANES] {
        let Self { nodes, bounds, .. } = self;
        let Bounds { slots, lanes, waiting, .. } = bounds;
        let lanes = in_lanes::<N>(lanes, slots.len());
        for (lane, &mark) in marks.iter().enumerate() {
            lanes[mark as usize][lane] = 1.0;
            waiting.add(mark);
        }
        let mut errors = [0.0; LANES];
        while let Some(index) = waiting.take_last() {
            let adjoints = std::mem::replace(&mut lanes[index as usize], [0.0; N]);
            if adjoints == [0.0; N] {
                continue;
            }
            let slot = &slots[index as usize];
            for (error, adjoint) in errors.iter_mut().zip(adjoints) {
                *error += if adjoint == 0.0 { 0.0 } else { adjoint.abs() * slot.own };
            }
            for (&part, partial) in nodes[index as usize].operands().iter().zip(slot.partials) {
                for (to, adjoint) in lanes[part as usize].iter_mut().zip(adjoints) {
                    *to += adjoint * partial;
                }
                waiting.add(part);
            }
        }
        errors
    }

    /// Fills `adjoint` and `reached` for the slots up to `mark`.
    fn sweep_back(&mut self, mark: u32) {
        self.evaluate();
        let Self { nodes, bounds, .. } = self;
        let Bounds { slots, adjoint, reached, .. } = bounds;
        adjoint.clear();
        adjoint.resize(mark as usize + 1, [0.0; 1]);
        sweep(nodes, slots, &[mark], adjoint, reached, |_, _| {});
    }
}

/// So many lanes for each of so many slots, in room that is zero.
fn in_lanes<const N: usize>(room: &mut Vec<[f64; LANES]>, slots: usize) -> &mut [[f64; N]] {
    if room.len() < slots {
        room.resize(slots, [0.0; LANES]);
    }
    room.as_flattened_mut().as_chunks_mut::<N>().0
}

/// Sweeps back from as many results as there are lanes, at most: how each of them moves when a slot is moved alone, and
/// to which of them a slot leads, a bit for each. The lanes are zero before; each slot that leads to a result is given to
/// `visit` when its adjoints are complete and have been handed on.
fn sweep<const N: usize>(
    nodes: &[Entry],
    slots: &[Slot],
    results: &[u32],
    adjoints: &mut [[f64; N]],
    reached: &mut Vec<u8>,
    mut visit: impl FnMut(&Slot, &mut [f64; N]),
) {
    let count = results.iter().max().map_or(0, |last| *last as usize + 1);
    reached.clear();
    reached.resize(count, 0);
    for (lane, &result) in results.iter().enumerate() {
        adjoints[result as usize][lane] = 1.0;
        reached[result as usize] |= 1 << lane;
    }
    for index in (0..count).rev() {
        let leads_to = reached[index];
        if leads_to == 0 {
            continue;
        }
        let adjoint = adjoints[index];
        for (&part, partial) in nodes[index].operands().iter().zip(slots[index].partials) {
            for (to, adjoint) in adjoints[part as usize].iter_mut().zip(adjoint) {
                *to += adjoint * partial;
            }
            reached[part as usize] |= leads_to;
        }
        visit(&slots[index], &mut adjoints[index]);
    }
}
