//! What the board remembers: the tape of its reckoning, from which every bound is read, and the
//! strokes, from which figures are drawn.
//!
//! The tape is a list of scalar results. Each holds its local rounding error and the partial
//! derivatives by which it hangs on earlier results. One sweep back from an asked result adds up what
//! every rounding and every uncertain number of the scene does to it, *with* the correlations that
//! running error bounds lose: a chain of twenty dyads keeps its digits.
//!
//! The bound is no estimate of first order. Let a result be reckoned as x̂ₖ = f(x̂) + δₖ, and let eₖ be the error
//! that it has. Then eₖ = Σ ∂f(x̂)·e + δₖ − ρₖ, where ρₖ is what the errors of the operands do to f beyond its
//! tangent: eₐ·e_b for a product, the quotient's own error times the divisor's relative one, and so on. These
//! equations are linear in e, so that the sweep back solves them without neglect: the error of the answer is
//! Σ ∂answer/∂xₖ·(δₖ − ρₖ), and its bound the sum of the sizes. A bound of ρₖ needs only rough bounds of the
//! operands' errors, since it is of second order in them: running ones, drawn in by sweeps of their own where
//! they are too rough for that.

use std::collections::BinaryHeap;
use std::fmt::Debug;

/// Which of the board's operations made a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// A place pricked from given coordinates.
    Prick,
    /// A length laid off from a point along a direction.
    LayOff,
    /// The meet of two lines.
    MeetLines,
    /// The meet of a line and a circle.
    MeetLineCircle,
    /// The meet of two circles.
    MeetCircles,
    /// A line divided in a ratio.
    Divide,
    /// The corner of a figure similar to a given one.
    Similar,
    /// The foot of a perpendicular.
    Foot,
}

impl Operation {
    /// The word of the text tape.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Prick => "prick",
            Self::LayOff => "lay off",
            Self::MeetLines => "meet line line",
            Self::MeetLineCircle => "meet line circle",
            Self::MeetCircles => "meet circle circle",
            Self::Divide => "divide",
            Self::Similar => "similar",
            Self::Foot => "foot",
        }
    }
}

/// A point that the draughtsman made, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stroke {
    /// The operation.
    pub operation: Operation,
    /// The point in paper millimetres.
    pub at: [f64; 2],
    /// Tape slots of its two coordinates.
    pub slots: [u32; 2],
    /// What it was drawn for.
    pub purpose: &'static str,
}

/// Why a division may fail: an index into the list that the caller of the board keeps.
pub type Reason = u32;

/// How a scalar was reckoned from earlier ones, in the order of the parts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reckoning {
    /// a + b.
    Sum,
    /// a − b.
    Difference,
    /// −a.
    Opposite,
    /// a · b.
    Product,
    /// a · factor.
    Times(f64),
    /// a / divisor.
    Over(f64),
    /// a / b.
    Quotient,
    /// √a; zero for a negative a.
    Root,
    /// √a of the square of a half chord: one of two meeting points hangs on its sign.
    HalfChord,
    /// a·b + c·d.
    Dot,
    /// a·b − c·d.
    Cross,
    /// cos a.
    Cosine,
    /// sin a.
    Sine,
    /// Angle of the vector (b, a) from +x.
    Angle,
    /// The same, of something that may turn more than half round.
    Turned,
}

/// What a human hand does with a pencil; each can slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pencil {
    /// Lays off a length, pricks a coordinate, sets the compass.
    Length,
    /// Draws a line in a direction.
    Direction,
    /// Reads a length off.
    Reading,
    /// Reads an angle off.
    AngleReading,
}

/// What listens to the board. Recording costs nothing where the recorder is [`Blank`].
pub trait Recorder {
    /// Handle of a recorded scalar.
    type Mark: Copy + Debug + Default;
    /// A number from outside with its radius of uncertainty.
    fn given(&mut self, value: f64, error: f64) -> Self::Mark;
    /// As [`Recorder::given`], for the place of an input, by its index.
    fn input(&mut self, _index: usize, value: f64, error: f64) -> Self::Mark {
        self.given(value, error)
    }
    /// As [`Recorder::given`], for how fast an input moves, by its index.
    fn input_rate(&mut self, _index: usize, value: f64, error: f64) -> Self::Mark {
        self.given(value, error)
    }
    /// A result: how it was reckoned from what, and the rounding of this operation alone.
    fn result(&mut self, step: Reckoning, parts: &[(Self::Mark, f64)], rounding: f64) -> Self::Mark;
    /// The slip of a human hand in one act, in millimetres or radians; `None` where the hand is perfect.
    fn pencil(&mut self, _kind: Pencil) -> Option<(f64, Self::Mark)> {
        None
    }
    /// A divisor whose value must stand clear of its own error.
    fn divisor(&mut self, mark: Self::Mark, value: f64, reason: Reason);
    /// First-order error of a recorded scalar, if this recorder knows.
    fn error(&mut self, mark: Self::Mark) -> Option<f64>;
    /// A point was made. What comes back is added to its place: zero, but for tests that nudge a
    /// stroke and for hands that tremble.
    fn stroke(
        &mut self,
        operation: Operation,
        at: [f64; 2],
        marks: [Self::Mark; 2],
        purpose: &'static str,
    ) -> [f64; 2];
}

/// Records nothing.
#[derive(Debug, Clone, Copy, Default)]
pub struct Blank;

impl Recorder for Blank {
    type Mark = ();

    fn given(&mut self, _: f64, _: f64) {}

    fn result(&mut self, _: Reckoning, _: &[((), f64)], _: f64) {}

    fn divisor(&mut self, (): (), _: f64, _: Reason) {}

    fn error(&mut self, (): ()) -> Option<f64> {
        None
    }

    fn stroke(&mut self, _: Operation, _: [f64; 2], _: [(); 2], _: &'static str) -> [f64; 2] {
        [0.0; 2]
    }
}

/// At most this many operands hang on one result.
const MOST_PARTS: usize = 4;
/// Bits of a word.
const WORD: usize = u64::BITS as usize;

#[derive(Debug, Clone, Copy)]
struct Slot {
    parts: [(u32, f64); MOST_PARTS],
    count: u8,
    /// What this reckoning adds to the error: its rounding, and what the tangent leaves out of it.
    own: f64,
    /// The error is no larger; without the correlations often much smaller.
    error: f64,
    /// A coordinate of a point that was drawn.
    is_point: bool,
    drawn_in: DrawnIn,
}

/// How far the error of a slot has been drawn in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum DrawnIn {
    /// It is a running error.
    Not,
    /// From the nearest points behind it, whose errors are drawn in by sweeps that end at points drawn in before.
    ToPoints,
    /// From the nearest points behind it, whose errors are drawn in by sweeps through the whole tape.
    ToExactPoints,
    /// By a sweep of its own through the whole tape.
    Wholly,
}

/// A divisor that does not stand clear of its error.
#[derive(Debug, Clone, Copy)]
struct WeakDivisor {
    slot: u32,
    reason: Reason,
}

/// A stroke to be moved after it is drawn, in paper millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nudge {
    /// Index into [`Tape::strokes`].
    pub stroke: usize,
    /// By how much.
    pub by: [f64; 2],
}

/// Records everything: reckoning and strokes.
#[derive(Debug, Clone, Default)]
pub struct Tape {
    slots: Vec<Slot>,
    weak: Vec<WeakDivisor>,
    strokes: Vec<Stroke>,
    nudge: Option<Nudge>,
    adjoint: Vec<f64>,
    reached: Vec<bool>,
    /// Scratch of local sweeps: zero between them.
    local: Vec<f64>,
    /// The slots that a local sweep has still to look at, a bit each.
    waiting: Vec<u64>,
}

/// How far operands are drawn in, one sweep after the other as long as what the tangent leaves out is more than
/// these parts of the rounding and of what the operands' errors do along the tangent. Running errors may be
/// too rough to measure anything by; the longer the sweep, the more must depend on it.
const SWEEPS: [(DrawnIn, f64, f64); 3] =
    [(DrawnIn::ToPoints, 1.0 / 64.0, 0.0), (DrawnIn::ToExactPoints, 1.0, 0.0), (DrawnIn::Wholly, 8.0, 1e-6)];

/// The partial derivatives are reckoned in doubles, by up to three roundings each.
pub(super) const OF_PARTIALS: f64 = 2.0 * f64::EPSILON;

impl Recorder for Tape {
    type Mark = u32;

    fn given(&mut self, _: f64, error: f64) -> u32 {
        self.push(&[], error)
    }

    fn result(&mut self, step: Reckoning, parts: &[(u32, f64)], rounding: f64) -> u32 {
        let mut beyond = self.beyond_the_tangent(step, parts);
        for (sweep, of_rounding, of_error) in SWEEPS {
            let first: f64 = parts.iter().map(|part| self.passed_on(part)).sum();
            let matters = beyond.left_out > of_rounding * rounding + of_error * first;
            if !matters || beyond.left_out.is_infinite() {
                break;
            }
            for (part, _) in parts {
                self.draw_in(*part, sweep);
            }
            beyond = self.beyond_the_tangent(step, parts);
        }
        if beyond.no_tangent {
            let still = [0, 1, 2, 3].map(|i| (parts.get(i).map_or(0, |part| part.0), 0.0));
            return self.push(&still[..parts.len().min(MOST_PARTS)], rounding + beyond.left_out);
        }
        let of_partials: f64 = parts.iter().map(|part| OF_PARTIALS * self.passed_on(part)).sum();
        self.push(parts, rounding + beyond.left_out + of_partials)
    }

    fn divisor(&mut self, mark: u32, value: f64, reason: Reason) {
        // Written so that a not-a-number counts as weak, and a zero that has no error.
        let clear = |tape: &Self| tape.error_of(mark) < WEAK_DIVISOR * value.abs();
        for (sweep, ..) in SWEEPS.into_iter().filter(|_| value != 0.0) {
            if !clear(self) {
                self.draw_in(mark, sweep);
            }
        }
        if !clear(self) {
            self.weak.push(WeakDivisor { slot: mark, reason });
        }
    }

    fn error(&mut self, mark: u32) -> Option<f64> {
        Some(self.total_error(mark))
    }

    fn stroke(
        &mut self,
        operation: Operation,
        at: [f64; 2],
        marks: [u32; 2],
        purpose: &'static str,
    ) -> [f64; 2] {
        let by = match self.nudge {
            Some(nudge) if nudge.stroke == self.strokes.len() => nudge.by,
            _ => [0.0; 2],
        };
        let at = [at[0] + by[0], at[1] + by[1]];
        for mark in marks {
            if let Some(slot) = self.slots.get_mut(mark as usize) {
                slot.is_point = true;
            }
        }
        self.strokes.push(Stroke { operation, at, slots: marks, purpose });
        by
    }
}

/// A divisor is too weak to divide by when its error passes this part of it.
pub(super) const WEAK_DIVISOR: f64 = 1.0 / 8.0;

/// The bound is itself reckoned in doubles.
pub(super) const ROUNDED: f64 = 1e-9;

/// What the errors of the operands do to a result beyond its tangent.
struct Beyond {
    /// At most so much; infinite where nobody can tell.
    left_out: f64,
    /// The errors are too large for a tangent: `left_out` is all that they do.
    no_tangent: bool,
}

impl Tape {
    /// A tape on which one stroke will be moved as it is drawn.
    #[must_use]
    pub fn nudged(nudge: Nudge) -> Self {
        Self { nudge: Some(nudge), ..Self::default() }
    }

    pub(super) fn push(&mut self, parts: &[(u32, f64)], own: f64) -> u32 {
        let mut slot = Slot {
            parts: [(0, 0.0); MOST_PARTS],
            count: 0,
            own,
            error: own,
            is_point: false,
            drawn_in: DrawnIn::Not,
        };
        for (to, from) in slot.parts.iter_mut().zip(parts) {
            *to = *from;
            slot.count += 1;
            slot.error += self.passed_on(from);
        }
        let mark = u32::try_from(self.slots.len()).unwrap_or(u32::MAX);
        self.slots.push(slot);
        mark
    }

    /// A bound of the error of a slot.
    fn error_of(&self, mark: u32) -> f64 {
        self.slots.get(mark as usize).map_or(f64::INFINITY, |slot| slot.error)
    }

    /// What an operand's error does to a result along the tangent. What does not move it may err without bound.
    fn passed_on(&self, &(part, partial): &(u32, f64)) -> f64 {
        if partial == 0.0 { 0.0 } else { partial.abs() * self.error_of(part) }
    }

    /// What the errors of the operands, as far as they are known, do to a result beyond its tangent.
    fn beyond_the_tangent(&self, step: Reckoning, parts: &[(u32, f64)]) -> Beyond {
        let error = |i: usize| parts.get(i).map_or(0.0, |part| self.error_of(part.0));
        let partial = |i: usize| parts.get(i).map_or(0.0, |part| part.1);
        // Exact zeros stay so beside what errs without bound.
        let both = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let along = |left_out: f64| Beyond { left_out, no_tangent: false };
        let all = |left_out: f64| Beyond { left_out, no_tangent: true };
        match step {
            Reckoning::Sum
            | Reckoning::Difference
            | Reckoning::Opposite
            | Reckoning::Times(_)
            | Reckoning::Over(_) => along(0.0),
            Reckoning::Product => along(both(error(0), error(1))),
            Reckoning::Dot | Reckoning::Cross => along(both(error(0), error(1)) + both(error(2), error(3))),
            // â/b̂ − a/b is its first order times b̂/b.
            Reckoning::Quotient => {
                let part = partial(0).abs() * error(1);
                let first = self.passed_on(&parts[0]) + self.passed_on(&parts[1]);
                if part < 0.5 { along(first * part / (1.0 - part)) } else { along(f64::INFINITY) }
            }
            // The root r of â = r² moves by r(1 − √(1 − t)) for an error of t â: r t/2, and at most r t²/2 beyond
            // it as long as t ≤ 1; and never by more than √(t â).
            Reckoning::Root | Reckoning::HalfChord => {
                let (twice, moved) = (2.0 * partial(0), error(0));
                let part = moved * twice * twice;
                if twice > 0.0 && part <= 1.0 {
                    along(part * part / (2.0 * twice))
                } else {
                    all(moved.sqrt())
                }
            }
            Reckoning::Cosine | Reckoning::Sine => along((0.5 * error(0) * error(0)).min(2.0 + error(0))),
            // The logarithm of 1 + z for |z| = ρ leaves its tangent by no more than ρ²/(2(1 − ρ)).
            Reckoning::Angle | Reckoning::Turned => {
                let reach = libm::hypot(partial(0), partial(1));
                let part = reach * libm::hypot(error(0), error(1));
                if reach > 0.0 && part <= 0.5 {
                    along(part * part / (2.0 * (1.0 - part)))
                } else {
                    all(std::f64::consts::PI)
                }
            }
        }
    }

    /// The strokes in the order of drawing.
    #[must_use]
    pub fn strokes(&self) -> &[Stroke] {
        &self.strokes
    }

    /// Bound of a recorded result: |value − truth| ≤ bound, unless [`Tape::weakness`] says that it has
    /// none.
    pub fn bound(&mut self, mark: u32) -> f64 {
        (1.0 + ROUNDED) * self.total_error(mark)
    }

    /// A bound that is at hand and often much larger than [`Tape::bound`], since it knows no correlations.
    #[must_use]
    pub fn rough_bound(&self, mark: u32) -> f64 {
        (1.0 + ROUNDED) * self.error_of(mark)
    }

    /// The part of [`Tape::bound`] that the numbers of the scene bring with them, each known to half a unit in its
    /// last place: no drawing can do better. In unit roundoffs, the conditioning of the result.
    pub fn inherited(&mut self, mark: u32) -> f64 {
        self.sweep_back(mark);
        let given =
            self.adjoint.iter().zip(&self.slots).filter(|(_, slot)| slot.count == 0 && slot.own > 0.0);
        given.map(|(adjoint, slot)| adjoint.abs() * slot.own).sum()
    }

    /// The reason of the first divisor behind this result that does not stand clear of its own error.
    pub fn weakness(&mut self, mark: u32) -> Option<Reason> {
        if self.weak.is_empty() {
            return None;
        }
        self.sweep_back(mark);
        let is_behind = |d: &&WeakDivisor| self.reached.get(d.slot as usize).copied().unwrap_or(false);
        self.weak.iter().find(is_behind).map(|d| d.reason)
    }

    /// ∂(result)/∂(slot): how the result moves when the slot is moved alone.
    pub fn sensitivity(&mut self, mark: u32, slot: u32) -> f64 {
        self.sweep_back(mark);
        self.adjoint.get(slot as usize).copied().unwrap_or(0.0)
    }

    /// What all slots together can do to a result.
    pub(super) fn total_error(&mut self, mark: u32) -> f64 {
        self.sweep_back(mark);
        // What does not lead to the result may err without bound.
        let moves = self.adjoint.iter().zip(&self.slots).filter(|(adjoint, _)| **adjoint != 0.0);
        moves.map(|(adjoint, slot)| adjoint.abs() * slot.own).sum()
    }

    /// Draws in the error of a slot, as far as this sweep can.
    ///
    /// Where the nearest points behind it are drawn in by sweeps that end at points drawn in before, the
    /// correlations within some ten groups count, and a long chain costs no more for each of its links than a
    /// short one.
    fn draw_in(&mut self, mark: u32, sweep: DrawnIn) {
        let Some(slot) = self.slots.get(mark as usize).filter(|slot| slot.drawn_in < sweep) else { return };
        let nothing = slot.error == 0.0;
        if nothing || sweep == DrawnIn::Wholly {
            let error = if nothing { 0.0 } else { self.error_behind(mark, false) };
            self.set_drawn_in(mark, error, sweep);
            return;
        }
        let mut points = Vec::new();
        let mut between = Vec::new();
        let mut heap = BinaryHeap::from([mark]);
        while let Some(index) = heap.pop() {
            // What is reached twice comes twice in a row.
            if heap.peek() == Some(&index) {
                continue;
            }
            let slot = &self.slots[index as usize];
            if slot.drawn_in >= sweep {
                continue;
            }
            if slot.is_point {
                points.push(index);
            } else {
                between.push(index);
                heap.extend(slot.parts[..usize::from(slot.count)].iter().map(|part| part.0));
            }
        }
        for &point in points.iter().rev() {
            let error = self.error_behind(point, sweep == DrawnIn::ToPoints);
            self.set_drawn_in(point, error, sweep);
        }
        for &index in between.iter().rev() {
            let slot = &self.slots[index as usize];
            let parts = slot.parts[..usize::from(slot.count)].iter();
            let error = slot.own + parts.map(|part| self.passed_on(part)).sum::<f64>();
            self.set_drawn_in(index, error, sweep);
        }
    }

    fn set_drawn_in(&mut self, mark: u32, error: f64, sweep: DrawnIn) {
        if let Some(slot) = self.slots.get_mut(mark as usize) {
            slot.error = slot.error.min(error);
            slot.drawn_in = sweep;
        }
    }

    /// A bound of the error of a slot, by a sweep back that may end at points that are drawn in.
    fn error_behind(&mut self, mark: u32, ends_at_points: bool) -> f64 {
        self.local.resize(self.slots.len(), 0.0);
        self.waiting.resize(self.slots.len().div_ceil(WORD), 0);
        let mut word = mark as usize / WORD;
        self.local[mark as usize] = 1.0;
        self.waiting[word] = 1 << (mark as usize % WORD);
        let (mut waiting, mut error) = (1_usize, 0.0);
        while waiting > 0 {
            // A slot hangs on earlier ones: the last that waits is the next. What is given stands at the very
            // beginning; the way there must not cost a step for each slot between.
            let Some(bit) = self.waiting[word].checked_ilog2() else {
                word -= 1;
                continue;
            };
            self.waiting[word] ^= 1 << bit;
            waiting -= 1;
            let index = word * WORD + bit as usize;
            let adjoint = std::mem::take(&mut self.local[index]);
            if adjoint != 0.0 {
                let slot = &self.slots[index];
                let known = slot.is_point && slot.drawn_in > DrawnIn::Not && index != mark as usize;
                if ends_at_points && known {
                    error += adjoint.abs() * slot.error;
                } else {
                    error += adjoint.abs() * slot.own;
                    for &(part, partial) in &slot.parts[..usize::from(slot.count)] {
                        let part = part as usize;
                        self.local[part] += adjoint * partial;
                        let (word, bit) = (part / WORD, 1 << (part % WORD));
                        waiting += usize::from(self.waiting[word] & bit == 0);
                        self.waiting[word] |= bit;
                    }
                }
            }
        }
        error
    }

    /// Fills `adjoint` and `reached` for the slots up to `mark`.
    fn sweep_back(&mut self, mark: u32) {
        let last = mark as usize;
        self.adjoint.clear();
        self.adjoint.resize(last + 1, 0.0);
        self.reached.clear();
        self.reached.resize(last + 1, false);
        self.adjoint[last] = 1.0;
        self.reached[last] = true;
        for index in (0..=last).rev() {
            if !self.reached[index] {
                continue;
            }
            let slot = &self.slots[index];
            let adjoint = self.adjoint[index];
            for &(part, partial) in &slot.parts[..usize::from(slot.count)] {
                self.adjoint[part as usize] += adjoint * partial;
                self.reached[part as usize] = true;
            }
        }
    }
}
