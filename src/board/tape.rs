//! What the board remembers: the tape of its reckoning, from which every bound is read, and the
//! strokes, from which figures are drawn.
//!
//! The tape is a list of scalar results. Each holds its local rounding error and the partial
//! derivatives by which it hangs on earlier results. One sweep back from an asked result adds up what
//! every rounding and every uncertain number of the scene does to it, *with* the correlations that
//! running error bounds lose: a chain of twenty dyads keeps its digits.

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

#[derive(Debug, Clone, Copy)]
struct Slot {
    parts: [(u32, f64); MOST_PARTS],
    count: u8,
    rounding: f64,
    /// Running error: never below the first-order error, but without correlations often far above it.
    running: f64,
    /// A coordinate of a point that was drawn.
    is_point: bool,
    /// The running error has been drawn in by a sweep of its own.
    is_tight: bool,
}

#[derive(Debug, Clone, Copy)]
struct Divisor {
    slot: u32,
    value: f64,
    reason: Reason,
    /// Its error as a part of it, as far as that is known.
    part: f64,
    weak: Option<bool>,
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
    divisors: Vec<Divisor>,
    strokes: Vec<Stroke>,
    nudge: Option<Nudge>,
    adjoint: Vec<f64>,
    reached: Vec<bool>,
    /// Scratch of local sweeps: zero and `false` between them.
    local: Vec<(f64, bool)>,
}

/// On a shorter tape nothing is drawn in: a divisor's own sweep costs less.
const LONG: usize = 4000;

/// From this part of a divisor its running error is drawn in.
const DOUBTFUL: f64 = 1e-6;

impl Recorder for Tape {
    type Mark = u32;

    fn given(&mut self, _: f64, error: f64) -> u32 {
        self.push(&[], error)
    }

    fn result(&mut self, step: Reckoning, parts: &[(u32, f64)], rounding: f64) -> u32 {
        let products = match step {
            Reckoning::Product | Reckoning::Dot | Reckoning::Cross => parts.chunks_exact(2),
            _ => [].chunks_exact(2),
        };
        let lost: f64 = products.map(|pair| self.lost_in_product(pair)).sum();
        self.push(parts, rounding + lost)
    }

    fn divisor(&mut self, mark: u32, value: f64, reason: Reason) {
        let running = |tape: &Self| tape.slots.get(mark as usize).map_or(f64::INFINITY, |slot| slot.running);
        let mut part = running(self) / value.abs();
        // Written so that a not-a-number is neither.
        let sure = part <= DOUBTFUL;
        if self.slots.len() > LONG && !sure {
            self.draw_in(mark);
            part = running(self) / value.abs();
        }
        let weak = (part <= WEAK_DIVISOR).then_some(false);
        self.divisors.push(Divisor { slot: mark, value, reason, part, weak });
    }

    fn error(&mut self, mark: u32) -> Option<f64> {
        Some(self.first_order_error(mark))
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

/// A divisor is too weak to divide by when its first-order error passes this part of it.
pub(super) const WEAK_DIVISOR: f64 = 1.0 / 8.0;

/// A divisor that errs by a part p of itself changes the derivatives behind it by (1 − p)⁻² − 1: for a part up to
/// an eighth less than this many p.
pub(super) const BEND: f64 = 4.0;

/// What second order may add to a first-order bound, at most: all of it again.
pub(super) const MOST_SECOND_ORDER: f64 = 1.0;

/// The bound is itself reckoned in doubles.
pub(super) const ROUNDED: f64 = 1e-9;

impl Tape {
    /// A tape on which one stroke will be moved as it is drawn.
    #[must_use]
    pub fn nudged(nudge: Nudge) -> Self {
        Self { nudge: Some(nudge), ..Self::default() }
    }

    pub(super) fn push(&mut self, parts: &[(u32, f64)], rounding: f64) -> u32 {
        let mut slot = Slot {
            parts: [(0, 0.0); MOST_PARTS],
            count: 0,
            rounding,
            running: rounding,
            is_point: false,
            is_tight: false,
        };
        for (to, from) in slot.parts.iter_mut().zip(parts) {
            *to = *from;
            slot.count += 1;
            let part = self.slots.get(from.0 as usize).map_or(0.0, |s| s.running);
            slot.running += from.1.abs() * part;
        }
        let mark = u32::try_from(self.slots.len()).unwrap_or(u32::MAX);
        self.slots.push(slot);
        mark
    }

    /// The strokes in the order of drawing.
    #[must_use]
    pub fn strokes(&self) -> &[Stroke] {
        &self.strokes
    }

    /// Bound of a recorded result: |value − truth| ≤ bound, unless [`Tape::weakness`] says that it has
    /// none.
    pub fn bound(&mut self, mark: u32) -> f64 {
        let parts: f64 = self.divisors.iter().map(|d| d.part.min(WEAK_DIVISOR)).sum();
        let second_order = (BEND * parts).min(MOST_SECOND_ORDER);
        (1.0 + second_order + ROUNDED) * self.first_order_error(mark)
    }

    /// The reason of the first divisor behind this result that does not stand clear of its own error.
    pub fn weakness(&mut self, mark: u32) -> Option<Reason> {
        for index in 0..self.divisors.len() {
            if self.divisors[index].weak.is_none() {
                // The running error was too large to tell.
                let Divisor { slot, value, .. } = self.divisors[index];
                let part = self.first_order_error(slot) / value.abs();
                self.divisors[index].part = part;
                // Written so that a not-a-number counts as weak.
                let clear = part <= WEAK_DIVISOR;
                self.divisors[index].weak = Some(!clear);
            }
        }
        if !self.divisors.iter().any(|d| d.weak == Some(true)) {
            return None;
        }
        self.sweep_back(mark);
        self.divisors
            .iter()
            .find(|d| d.weak == Some(true) && self.reached.get(d.slot as usize).copied().unwrap_or(false))
            .map(|d| d.reason)
    }

    /// ∂(result)/∂(slot): how the result moves when the slot is moved alone.
    pub fn sensitivity(&mut self, mark: u32, slot: u32) -> f64 {
        self.sweep_back(mark);
        self.adjoint.get(slot as usize).copied().unwrap_or(0.0)
    }

    pub(super) fn first_order_error(&mut self, mark: u32) -> f64 {
        self.sweep_back(mark);
        // What does not lead to the result may err without bound.
        let moves = self.adjoint.iter().zip(&self.slots).filter(|(adjoint, _)| **adjoint != 0.0);
        moves.map(|(adjoint, slot)| adjoint.abs() * slot.rounding).sum()
    }

    /// The error of a product of which both factors are zero within their errors: first order says nothing of it.
    /// Each factor stands beside the partial derivative by the other.
    fn lost_in_product(&mut self, pair: &[(u32, f64)]) -> f64 {
        let &[(a, value_of_b), (b, value_of_a)] = pair else { return 0.0 };
        let running = |tape: &Self, mark: u32| tape.slots.get(mark as usize).map_or(0.0, |s| s.running);
        let vanish = |[e, f]: [f64; 2]| e > 0.0 && f > 0.0 && e >= value_of_a.abs() && f >= value_of_b.abs();
        if !vanish([running(self, a), running(self, b)]) {
            return 0.0;
        }
        let errors = [self.local_error(a), self.local_error(b)];
        if vanish(errors) { errors[0] * errors[1] } else { 0.0 }
    }

    /// Draws in the running errors behind a result: those of the nearest points behind it by sweeps that end at
    /// points drawn in before, and with them those between. So the correlations within some ten groups count,
    /// and a long chain costs no more for each of its links than a short one.
    fn draw_in(&mut self, mark: u32) {
        let mut points = Vec::new();
        let mut between = Vec::new();
        let mut heap = BinaryHeap::from([mark]);
        while let Some(index) = heap.pop() {
            // What is reached twice comes twice in a row.
            if heap.peek() == Some(&index) {
                continue;
            }
            let slot = &self.slots[index as usize];
            if index != mark && slot.is_point {
                points.push(index);
            } else {
                between.push(index);
                heap.extend(slot.parts[..usize::from(slot.count)].iter().map(|part| part.0));
            }
        }
        for &point in points.iter().rev() {
            if !self.slots[point as usize].is_tight {
                let error = self.local_error(point);
                let slot = &mut self.slots[point as usize];
                slot.running = slot.running.min(error);
                slot.is_tight = true;
            }
        }
        for &index in between.iter().rev() {
            let slot = &self.slots[index as usize];
            let parts = slot.parts[..usize::from(slot.count)].iter();
            let running = parts
                .fold(slot.rounding, |sum, (part, by)| sum + by.abs() * self.slots[*part as usize].running);
            let slot = &mut self.slots[index as usize];
            slot.running = slot.running.min(running);
        }
    }

    /// A bound of the first-order error: a sweep back that ends at the points that are drawn in.
    fn local_error(&mut self, mark: u32) -> f64 {
        self.local.resize(self.slots.len(), (0.0, false));
        self.local[mark as usize] = (1.0, true);
        let mut heap = BinaryHeap::from([mark]);
        let mut error = 0.0;
        while let Some(index) = heap.pop() {
            let slot = &self.slots[index as usize];
            let (adjoint, _) = std::mem::take(&mut self.local[index as usize]);
            if index != mark && slot.is_tight {
                error += adjoint.abs() * slot.running;
                continue;
            }
            error += adjoint.abs() * slot.rounding;
            for &(part, partial) in &slot.parts[..usize::from(slot.count)] {
                let (sum, reached) = &mut self.local[part as usize];
                *sum += adjoint * partial;
                if !*reached {
                    *reached = true;
                    heap.push(part);
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
