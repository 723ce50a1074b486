//! A program that bounds its numbers, position by position: what the tape does for one drawing, for a few
//! positions at a time and without allocation.
//!
//! Forward every operation notes its rounding, what the errors of its operands do to it beyond its tangent, and a
//! running error, by the rules of `op.rs`; from each asked number one sweep back over the operations
//! adds up what every rounding and every uncertain number does to it, with their correlations. The running errors serve
//! to see that divisors stand clear, and for what the tangent leaves out; where they are too rough for that they are
//! replaced by sweeps of their own, as on the tape.
//!
//! Numbers that depend on nothing that is varied were computed before; each counts with its own error, as if it
//! were independent of the others.

use super::bounds::{ROUNDED, WEAK_DIVISOR};
use super::op::{Beyond, OF_PARTIALS, Op};
use super::program::{FoundByTrial, Node, Transcript, U, angle_near, signed};

/// Positions that are bounded together: fewer than are computed, for four numbers stand for each.
pub const FEW: usize = 8;

/// One number for each of [`FEW`] positions.
type Few = [f64; FEW];

#[derive(Debug, Clone, Copy)]
struct Step {
    op: Op,
    to: u32,
    /// Of a sine and cosine: where the sine goes. Of a quotient, root or angle: where the reciprocal goes
    /// by which the derivatives are computed.
    second: u32,
    from: [u32; 4],
}

#[derive(Debug, Clone)]
struct Target {
    row: u32,
    /// Indices of the divisors behind it.
    divisors: Vec<u32>,
}

/// A transcribed drawing that bounds its asked numbers.
#[derive(Debug, Clone)]
pub struct BoundedProgram {
    steps: Vec<Step>,
    /// How many signs of half chords stand before the half turns.
    chord_slots: usize,
    /// Row, value, error.
    constants: Vec<(u32, f64, f64)>,
    rows: u32,
    /// The step that makes a row; `None` for a constant and the input.
    made_by: Vec<Option<u32>>,
    asked: Vec<Target>,
    /// Rows of the numbers that are divided by.
    divisors: Vec<u32>,
    /// What is found by trial: its place among the trials of the drawing; the rows of where it stands and of how its miss
    /// changes there.
    trials: Vec<(usize, [u32; 2])>,
}

/// Room for a few positions with their bounds.
#[derive(Debug, Clone)]
pub struct BoundedBlock {
    values: Vec<Few>,
    running: Vec<Few>,
    roundings: Vec<Few>,
    adjoints: Vec<Few>,
    reached: Vec<bool>,
    /// Rows whose running error has been replaced by a sweep of its own.
    drawn_in: Vec<bool>,
    /// The error of each divisor as a part of it.
    parts: Vec<Few>,
    /// Of the asked numbers; infinite where a number is not determined.
    bounds: Vec<Few>,
}

impl BoundedBlock {
    /// The asked numbers, in order, each with its bound: |value − truth| ≤ bound. The bound is infinite where a
    /// divisor behind the number does not exceed its own error.
    pub fn asked<'a>(
        &'a self,
        program: &'a BoundedProgram,
    ) -> impl Iterator<Item = (&'a [f64; FEW], &'a [f64; FEW])> {
        program
            .asked
            .iter()
            .zip(&self.bounds)
            .map(|(target, bound)| (&self.values[target.row as usize], bound))
    }
}

impl BoundedProgram {
    pub(super) fn new(transcript: &Transcript, asked: &[u32]) -> Self {
        let nodes = &transcript.nodes;
        let mut needed = vec![false; nodes.len()];
        for &slot in asked {
            for (needed, reached) in needed.iter_mut().zip(transcript.behind(slot)) {
                *needed |= reached;
            }
        }
        let mut program = Self {
            steps: Vec::new(),
            chord_slots: transcript.chords.len(),
            constants: Vec::new(),
            rows: 1,
            made_by: vec![None],
            asked: Vec::new(),
            divisors: Vec::new(),
            trials: Vec::new(),
        };
        let mut rows = vec![0_u32; nodes.len()];
        for (slot, node) in nodes.iter().enumerate() {
            match *node {
                _ if !needed[slot] => {}
                Node::Input => {}
                // Found elsewhere, for every place anew.
                Node::Tried => rows[slot] = program.row(None),
                Node::Constant(value, error) => {
                    rows[slot] = program.row(None);
                    program.constants.push((rows[slot], value, error));
                }
                Node::Made(op, of) => program.transcribe(transcript, (slot, op, of), &mut rows),
            }
        }
        // A number that is divided by twice need stand clear only once.
        let made = |slot: u32| matches!(nodes.get(slot as usize), Some(Node::Made(..)));
        let mut divisors: Vec<u32> = transcript.divisors.iter().map(|d| d.0).collect();
        divisors.retain(|&slot| made(slot) && needed[slot as usize]);
        divisors.sort_unstable();
        divisors.dedup();
        for &slot in asked {
            let reached = transcript.behind(slot);
            let of = (0_u32..).zip(&divisors).filter(|(_, d)| reached[**d as usize]).map(|(index, _)| index);
            program.asked.push(Target { row: rows[slot as usize], divisors: of.collect() });
        }
        let tried = transcript.trials.iter().enumerate();
        program.trials = tried
            .filter(|(_, trial)| needed.get(trial.corrected as usize).copied().unwrap_or(false))
            .map(|(index, trial)| (index, [trial.found, trial.slope].map(|slot| rows[slot as usize])))
            .collect();
        program.divisors = divisors.into_iter().map(|slot| rows[slot as usize]).collect();
        program
    }

    fn row(&mut self, made_by: Option<u32>) -> u32 {
        self.made_by.push(made_by);
        self.rows += 1;
        self.rows - 1
    }

    fn transcribe(
        &mut self,
        transcript: &Transcript,
        (slot, op, of): (usize, Op, [u32; 4]),
        rows: &mut [u32],
    ) {
        if rows[slot] != 0 {
            // The sine of a cosine that stands already.
            return;
        }
        let mut from = of.map(|slot| rows.get(slot as usize).copied().unwrap_or(0));
        if op == Op::HalfChord {
            from[1] = transcript.chord_of(of[1]);
        }
        if op == Op::Turned {
            // Where its half turns stand among the signs.
            from[2] = u32::try_from(self.chord_slots).unwrap_or(u32::MAX).saturating_add(of[2]);
        }
        let index = u32::try_from(self.steps.len()).unwrap_or(u32::MAX);
        let to = self.row(Some(index));
        let second = match op {
            Op::Cosine | Op::Sine => self.row(Some(index)),
            Op::Quotient | Op::Root | Op::HalfChord | Op::Angle | Op::Turned => self.row(None),
            _ => 0,
        };
        // Sine and cosine are computed in one go, the cosine first.
        let (op, rows_here) = match op {
            Op::Cosine | Op::Sine => (Op::Cosine, [(Op::Cosine, to), (Op::Sine, second)].to_vec()),
            op => (op, vec![(op, to)]),
        };
        for (made, row) in rows_here {
            if let Some(slot) = transcript.made(made, of) {
                rows[slot as usize] = row;
            }
        }
        self.steps.push(Step { op, to, second, from });
    }

    /// How many operations it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing depends on what is varied.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// How many signs of half chords stand before the half turns.
    #[must_use]
    pub fn chord_slots(&self) -> usize {
        self.chord_slots
    }

    /// Room for blocks of positions, with the constants in place.
    #[must_use]
    pub fn block(&self) -> BoundedBlock {
        let rows = self.rows as usize;
        let mut block = BoundedBlock {
            values: vec![[0.0; FEW]; rows],
            running: vec![[0.0; FEW]; rows],
            roundings: vec![[0.0; FEW]; rows],
            adjoints: vec![[0.0; FEW]; rows],
            reached: vec![false; rows],
            drawn_in: vec![false; rows],
            parts: vec![[0.0; FEW]; self.divisors.len()],
            bounds: vec![[0.0; FEW]; self.asked.len()],
        };
        for &(row, value, error) in &self.constants {
            block.values[row as usize] = [value; FEW];
            block.running[row as usize] = [error; FEW];
            block.roundings[row as usize] = [error; FEW];
        }
        block
    }

    /// Computes a few positions and the bounds of their numbers. `errors` is how far each input may be off; `signs`
    /// has one number, 1 or −1, for each chord; `found` says what every trial of the drawing found at each position
    /// ([`super::Workspace::found`]).
    pub fn run(
        &self,
        inputs: &[f64; FEW],
        errors: &[f64; FEW],
        (signs, found): (&[f64], &[Vec<FoundByTrial>; FEW]),
        block: &mut BoundedBlock,
    ) {
        block.values[0] = *inputs;
        block.running[0] = *errors;
        block.roundings[0] = *errors;
        block.drawn_in.fill(false);
        for &(index, [at, slope]) in &self.trials {
            for (i, found) in found.iter().enumerate() {
                let found = found.get(index).copied().unwrap_or_default();
                // Any place will do from which a step of false position leads on; the slope of the miss is measured.
                block.values[at as usize][i] = found.at;
                block.values[slope as usize][i] = found.slope;
                block.running[slope as usize][i] = found.slope_error;
                block.roundings[slope as usize][i] = found.slope_error;
            }
        }
        for step in &self.steps {
            if forward(step, signs, block) && self.draw_in(step, block) {
                forward(step, signs, block);
            }
        }
        self.judge(block);
        for index in 0..self.asked.len() {
            let target = &self.asked[index];
            let error = self.sweep_back(target.row, block);
            let mut bound = [0.0; FEW];
            let mut weak = [false; FEW];
            for &divisor in &target.divisors {
                let part = &block.parts[divisor as usize];
                for i in 0..FEW {
                    // Written so that a not-a-number counts as weak.
                    let clear = part[i] <= WEAK_DIVISOR;
                    weak[i] |= !clear;
                }
            }
            for i in 0..FEW {
                bound[i] = if weak[i] { f64::INFINITY } else { (1.0 + ROUNDED) * error[i] };
                if !(bound[i].is_finite() && block.values[target.row as usize][i].is_finite()) {
                    bound[i] = f64::INFINITY;
                }
            }
            block.bounds[index] = bound;
        }
    }

    /// Replaces the running errors of an operation's operands by sweeps of their own; false where that was done before.
    fn draw_in(&self, step: &Step, block: &mut BoundedBlock) -> bool {
        let mut sharper = false;
        for &row in &step.from[..step.op.operands()] {
            if std::mem::replace(&mut block.drawn_in[row as usize], true) {
                continue;
            }
            let error = self.sweep_back(row, block);
            for (running, error) in block.running[row as usize].iter_mut().zip(error) {
                let error = (1.0 + ROUNDED) * error;
                // Written so that a not-a-number is no improvement.
                if error < *running {
                    *running = error;
                    sharper = true;
                }
            }
        }
        sharper
    }

    /// The error of each divisor as a part of it: by its running error, and where that does not tell, by a sweep of
    /// its own.
    fn judge(&self, block: &mut BoundedBlock) {
        for (index, &divisor) in self.divisors.iter().enumerate() {
            let row = divisor as usize;
            let part_of =
                |error: &Few, value: &Few| -> Few { std::array::from_fn(|i| error[i] / value[i].abs()) };
            let mut part = part_of(&block.running[row], &block.values[row]);
            let clear = part.iter().all(|p| *p <= WEAK_DIVISOR);
            if !clear {
                let error = self.sweep_back(divisor, block);
                part = part_of(&error, &block.values[row]);
            }
            block.parts[index] = part;
        }
    }

    /// First-order error of a row: every rounding before it times how it moves the number.
    fn sweep_back(&self, row: u32, block: &mut BoundedBlock) -> Few {
        let BoundedBlock { values, roundings, adjoints, reached, .. } = block;
        let mut back = Back { adjoints, reached };
        back.add(row, |_| 1.0);
        let mut error = [0.0; FEW];
        let mut spend = |row: u32, g: &Few| {
            let rounding = &roundings[row as usize];
            for i in 0..FEW {
                // What does not move the number may err without bound.
                error[i] += if g[i] == 0.0 { 0.0 } else { g[i].abs() * rounding[i] };
            }
        };
        let from = self.made_by[row as usize].map_or(0, |step| step as usize + 1);
        for step in self.steps[..from].iter().rev() {
            let [a, b, c, d] = step.from;
            if step.op == Op::Cosine {
                let cosine = back.take(step.to);
                let sine = back.take(step.second);
                if cosine.is_none() && sine.is_none() {
                    continue;
                }
                let (gc, gs) = (cosine.unwrap_or_default(), sine.unwrap_or_default());
                spend(step.to, &gc);
                spend(step.second, &gs);
                let (cos, sin) = (&values[step.to as usize], &values[step.second as usize]);
                back.add(a, |i| gs[i] * cos[i] - gc[i] * sin[i]);
                continue;
            }
            let Some(g) = back.take(step.to) else { continue };
            spend(step.to, &g);
            let value = |row: u32| &values[row as usize];
            match step.op {
                Op::Sum => {
                    back.add(a, |i| g[i]);
                    back.add(b, |i| g[i]);
                }
                Op::Difference => {
                    back.add(a, |i| g[i]);
                    back.add(b, |i| -g[i]);
                }
                Op::Opposite => back.add(a, |i| -g[i]),
                Op::Product => {
                    let (x, y) = (value(a), value(b));
                    back.add(a, |i| g[i] * y[i]);
                    back.add(b, |i| g[i] * x[i]);
                }
                Op::Quotient => {
                    let (quotient, inverse) = (value(step.to), value(step.second));
                    back.add(a, |i| g[i] * inverse[i]);
                    back.add(b, |i| -(g[i] * inverse[i]) * quotient[i]);
                }
                Op::Root | Op::HalfChord => {
                    let inverse = value(step.second);
                    back.add(a, |i| g[i] * inverse[i]);
                }
                Op::Dot | Op::Cross => {
                    let (x, y, z, w) = (value(a), value(b), value(c), value(d));
                    let sign = if step.op == Op::Dot { 1.0 } else { -1.0 };
                    back.add(a, |i| g[i] * y[i]);
                    back.add(b, |i| g[i] * x[i]);
                    back.add(c, |i| sign * g[i] * w[i]);
                    back.add(d, |i| sign * g[i] * z[i]);
                }
                Op::Angle | Op::Turned => {
                    let (y, x, inverse) = (value(a), value(b), value(step.second));
                    back.add(a, |i| g[i] * x[i] * inverse[i]);
                    back.add(b, |i| -(g[i] * y[i] * inverse[i]));
                }
                Op::Cosine | Op::Sine | Op::Whole => {}
            }
        }
        if let Some(g) = back.take(0) {
            spend(0, &g);
        }
        let from_outside = self.trials.iter().flat_map(|(_, rows)| *rows);
        for row in self.constants.iter().map(|constant| constant.0).chain(from_outside) {
            if let Some(g) = back.take(row) {
                spend(row, &g);
            }
        }
        error
    }
}

/// The derivatives of one number by all before it; zero and not reached between sweeps.
struct Back<'b> {
    adjoints: &'b mut [Few],
    reached: &'b mut [bool],
}

impl Back<'_> {
    #[inline]
    fn add(&mut self, row: u32, by: impl Fn(usize) -> f64) {
        let adjoint = &mut self.adjoints[row as usize];
        if std::mem::replace(&mut self.reached[row as usize], true) {
            for (i, a) in adjoint.iter_mut().enumerate() {
                *a += by(i);
            }
        } else {
            *adjoint = std::array::from_fn(by);
        }
    }

    #[inline]
    fn take(&mut self, row: u32) -> Option<Few> {
        std::mem::take(&mut self.reached[row as usize]).then(|| self.adjoints[row as usize])
    }
}

/// What the tangent leaves out counts where it is more than so much of the rounding, or this part of what the errors of
/// the operands do along the tangent: there the operands are worth a sweep (as `SWEEPS` of the tape).
const MATTERS: [f64; 2] = [8.0, 1e-6];

/// One operation with its rounding and its running error. Says whether what the tangent leaves out matters, so that the
/// operands' errors are better drawn in.
#[inline]
fn forward(step: &Step, signs: &[f64], block: &mut BoundedBlock) -> bool {
    // Each operation on its own, so that the compiler makes a loop without branches of it.
    match step.op {
        Op::Sum => operate(Op::Sum, step, signs, block),
        Op::Difference => operate(Op::Difference, step, signs, block),
        Op::Opposite => operate(Op::Opposite, step, signs, block),
        Op::Product => operate(Op::Product, step, signs, block),
        Op::Quotient => operate(Op::Quotient, step, signs, block),
        Op::Root => operate(Op::Root, step, signs, block),
        Op::HalfChord => operate(Op::HalfChord, step, signs, block),
        Op::Dot => operate(Op::Dot, step, signs, block),
        Op::Cross => operate(Op::Cross, step, signs, block),
        Op::Angle => operate(Op::Angle, step, signs, block),
        Op::Turned => operate(Op::Turned, step, signs, block),
        Op::Whole => operate(Op::Whole, step, signs, block),
        Op::Cosine | Op::Sine => cosine_and_sine(step, block),
    }
}

/// What one lane of an operation comes to.
struct Judged {
    /// Its rounding, and what the tangent leaves out.
    own: f64,
    /// That and what the operands' errors do along the tangent.
    running: f64,
    has_tangent: bool,
    matters: bool,
}

#[inline(always)]
fn judged(op: Op, count: usize, at: [f64; 4], value: f64, slopes: &[f64; 4], errors: &[f64; 4]) -> Judged {
    let mut along = 0.0;
    for k in 0..count {
        along += if slopes[k] == 0.0 || errors[k] == 0.0 { 0.0 } else { slopes[k].abs() * errors[k] };
    }
    let own = op.rounding::<f64>(at, value);
    let Beyond { left_out, has_tangent } = op.beyond(&at, slopes, errors, along);
    // Written so that a not-a-number matters.
    let idle = left_out <= MATTERS[0] * own + MATTERS[1] * along;
    let kept = if has_tangent { along } else { 0.0 };
    let own = own + left_out + OF_PARTIALS * kept;
    Judged { own, running: own + kept, has_tangent, matters: !idle }
}

#[inline(always)]
fn operate(op: Op, step: &Step, signs: &[f64], block: &mut BoundedBlock) -> bool {
    let BoundedBlock { values, running, roundings, .. } = block;
    let count = op.operands();
    let of = step.from.map(|row| row as usize);
    let sign = if op == Op::HalfChord { signs.get(of[1]).copied().unwrap_or(1.0) } else { 1.0 };
    let half_turns = if op == Op::Turned { signs.get(of[2]).copied().unwrap_or(0.0) } else { 0.0 };
    let (mut numbers, mut errors_of) = ([[0.0; FEW]; 4], [[0.0; FEW]; 4]);
    for k in 0..count {
        (numbers[k], errors_of[k]) = (values[of[k]], running[of[k]]);
    }
    let (mut out, mut own, mut error, mut inverse) = ([0.0; FEW], [0.0; FEW], [0.0; FEW], [0.0; FEW]);
    let mut matters = false;
    for i in 0..FEW {
        let at = [numbers[0][i], numbers[1][i], numbers[2][i], numbers[3][i]];
        let errors = [errors_of[0][i], errors_of[1][i], errors_of[2][i], errors_of[3][i]];
        out[i] = if half_turns == 0.0 { signed(op, at, sign) } else { angle_near(half_turns, at[0], at[1]) };
        let slopes = op.partials(at, out[i]);
        let judged = judged(op, count, at, out[i], &slopes, &errors);
        // Half turns are rounded themselves before they are added.
        let of_half_turns = 2.0 * U * std::f64::consts::PI * half_turns.abs();
        (own[i], error[i]) = (judged.own + of_half_turns, judged.running + of_half_turns);
        matters |= judged.matters;
        inverse[i] = match op {
            _ if !judged.has_tangent => 0.0,
            Op::Angle | Op::Turned => {
                let square = at[0] * at[0] + at[1] * at[1];
                if square > 0.0 { 1.0 / square } else { 0.0 }
            }
            _ => slopes[0],
        };
    }
    let to = step.to as usize;
    (values[to], roundings[to], running[to]) = (out, own, error);
    if matches!(op, Op::Quotient | Op::Root | Op::HalfChord | Op::Angle | Op::Turned) {
        values[step.second as usize] = inverse;
    }
    matters
}

/// Both in one go.
fn cosine_and_sine(step: &Step, block: &mut BoundedBlock) -> bool {
    let BoundedBlock { values, running, roundings, .. } = block;
    let [angle, cosine, sine] = [step.from[0], step.to, step.second].map(|row| row as usize);
    let mut matters = false;
    for i in 0..FEW {
        let (x, error) = (values[angle][i], [running[angle][i], 0.0, 0.0, 0.0]);
        let (sin, cos) = libm::sincos(x);
        for (op, to, value, slope) in [(Op::Cosine, cosine, cos, -sin), (Op::Sine, sine, sin, cos)] {
            let at = [x, 0.0, 0.0, 0.0];
            let judged = judged(op, 1, at, value, &[slope, 0.0, 0.0, 0.0], &error);
            values[to][i] = value;
            (roundings[to][i], running[to][i]) = (judged.own, judged.running);
            matters |= judged.matters;
        }
    }
    matters
}
