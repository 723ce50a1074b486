//! A program that bounds its numbers, position by position: what the tape does for one drawing, for a few
//! positions at a time and without allocation.
//!
//! Forward every operation notes its rounding and a running error, by the rules of `reckon.rs`; from each asked
//! number one sweep back over the operations adds up what every rounding and every uncertain number does to it,
//! with their correlations. The running errors serve only to see that divisors stand clear; unlike on the tape, where
//! what first order leaves out is bounded term by term, it counts here by the parts by which the divisors err.
//!
//! Numbers that hang on nothing that is varied were reckoned before; each counts with its own error, as if it
//! were independent of the others.

use super::program::{Kind, Node, TRANSCENDENTAL, Transcript, U};
use super::tape::{ROUNDED, WEAK_DIVISOR};

/// A divisor that errs by a part p of itself changes the derivatives behind it by (1 − p)⁻² − 1: for a part up to
/// an eighth less than this many p.
const BEND: f64 = 4.0;

/// What second order may add to a first-order bound, at most: all of it again.
const MOST_SECOND_ORDER: f64 = 1.0;

/// Positions that are bounded together: fewer than are reckoned, for four numbers stand for each.
pub const FEW: usize = 8;

/// One number for each of [`FEW`] positions.
type Few = [f64; FEW];

#[derive(Debug, Clone, Copy)]
struct Step {
    kind: Kind,
    to: u32,
    /// Of a sine and cosine: where the sine goes. Of a quotient, root or angle: where the reciprocal goes
    /// by which the derivatives are reckoned.
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
    /// Row, value, error.
    constants: Vec<(u32, f64, f64)>,
    rows: u32,
    /// The step that makes a row; `None` for a constant and the input.
    made_by: Vec<Option<u32>>,
    asked: Vec<Target>,
    /// Rows of the numbers that are divided by.
    divisors: Vec<u32>,
}

/// Room for a few positions with their bounds.
#[derive(Debug, Clone)]
pub struct BoundedBlock {
    values: Vec<Few>,
    running: Vec<Few>,
    roundings: Vec<Few>,
    adjoints: Vec<Few>,
    reached: Vec<bool>,
    /// The error of each divisor as a part of it.
    parts: Vec<Few>,
    /// Of the asked numbers; infinite where a number is not determined.
    bounds: Vec<Few>,
}

impl BoundedBlock {
    /// The asked numbers, in order, each with its bound: |value − truth| ≤ bound. The bound is infinite where a
    /// divisor behind the number does not stand clear of its own error.
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
            constants: Vec::new(),
            rows: 1,
            made_by: vec![None],
            asked: Vec::new(),
            divisors: Vec::new(),
        };
        let mut rows = vec![0_u32; nodes.len()];
        for (slot, node) in nodes.iter().enumerate() {
            match *node {
                _ if !needed[slot] => {}
                Node::Input => {}
                Node::Constant(value, error) => {
                    rows[slot] = program.row(None);
                    program.constants.push((rows[slot], value, error));
                }
                Node::Made(kind, of) => program.transcribe(transcript, (slot, kind, of), &mut rows),
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
        (slot, kind, of): (usize, Kind, [u32; 4]),
        rows: &mut [u32],
    ) {
        if rows[slot] != 0 {
            // The sine of a cosine that stands already.
            return;
        }
        let mut from = of.map(|slot| rows.get(slot as usize).copied().unwrap_or(0));
        if kind == Kind::HalfChord {
            from[1] = of[1];
        }
        let index = u32::try_from(self.steps.len()).unwrap_or(u32::MAX);
        let to = self.row(Some(index));
        let second = match kind {
            Kind::Cosine | Kind::Sine => self.row(Some(index)),
            Kind::Quotient | Kind::Root | Kind::HalfChord | Kind::Angle | Kind::Turned => self.row(None),
            _ => 0,
        };
        // Sine and cosine are reckoned in one go, the cosine first.
        let (kind, rows_here) = match kind {
            Kind::Cosine | Kind::Sine => (Kind::Cosine, [(Kind::Cosine, to), (Kind::Sine, second)].to_vec()),
            kind => (kind, vec![(kind, to)]),
        };
        for (made, row) in rows_here {
            if let Some(slot) = transcript.made(made, of) {
                rows[slot as usize] = row;
            }
        }
        self.steps.push(Step { kind, to, second, from });
    }

    /// How many operations it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing hangs on what is varied.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
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

    /// Reckons a few positions and the bounds of their numbers. `errors` is how far each input may be off; `signs`
    /// has one number, 1 or −1, for each chord.
    pub fn run(&self, inputs: &[f64; FEW], errors: &[f64; FEW], signs: &[f64], block: &mut BoundedBlock) {
        block.values[0] = *inputs;
        block.running[0] = *errors;
        block.roundings[0] = *errors;
        for step in &self.steps {
            forward(step, signs, block);
        }
        self.judge(block);
        for index in 0..self.asked.len() {
            let target = &self.asked[index];
            let error = self.sweep_back(target.row, block);
            let mut bound = [0.0; FEW];
            let mut bend = [0.0; FEW];
            let mut weak = [false; FEW];
            for &divisor in &target.divisors {
                let part = &block.parts[divisor as usize];
                for i in 0..FEW {
                    bend[i] += part[i].min(WEAK_DIVISOR);
                    // Written so that a not-a-number counts as weak.
                    let clear = part[i] <= WEAK_DIVISOR;
                    weak[i] |= !clear;
                }
            }
            for i in 0..FEW {
                let second_order = (BEND * bend[i]).min(MOST_SECOND_ORDER);
                let first_order = if weak[i] { f64::INFINITY } else { error[i] };
                bound[i] = (1.0 + second_order + ROUNDED) * first_order;
                if !(bound[i].is_finite() && block.values[target.row as usize][i].is_finite()) {
                    bound[i] = f64::INFINITY;
                }
            }
            block.bounds[index] = bound;
        }
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
            if step.kind == Kind::Cosine {
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
            match step.kind {
                Kind::Sum => {
                    back.add(a, |i| g[i]);
                    back.add(b, |i| g[i]);
                }
                Kind::Difference => {
                    back.add(a, |i| g[i]);
                    back.add(b, |i| -g[i]);
                }
                Kind::Opposite => back.add(a, |i| -g[i]),
                Kind::Product => {
                    let (x, y) = (value(a), value(b));
                    back.add(a, |i| g[i] * y[i]);
                    back.add(b, |i| g[i] * x[i]);
                }
                Kind::Quotient => {
                    let (quotient, inverse) = (value(step.to), value(step.second));
                    back.add(a, |i| g[i] * inverse[i]);
                    back.add(b, |i| -(g[i] * inverse[i]) * quotient[i]);
                }
                Kind::Root | Kind::HalfChord => {
                    let inverse = value(step.second);
                    back.add(a, |i| g[i] * inverse[i]);
                }
                Kind::Dot | Kind::Cross => {
                    let (x, y, z, w) = (value(a), value(b), value(c), value(d));
                    let sign = if step.kind == Kind::Dot { 1.0 } else { -1.0 };
                    back.add(a, |i| g[i] * y[i]);
                    back.add(b, |i| g[i] * x[i]);
                    back.add(c, |i| sign * g[i] * w[i]);
                    back.add(d, |i| sign * g[i] * z[i]);
                }
                Kind::Angle | Kind::Turned => {
                    let (y, x, inverse) = (value(a), value(b), value(step.second));
                    back.add(a, |i| g[i] * x[i] * inverse[i]);
                    back.add(b, |i| -(g[i] * y[i] * inverse[i]));
                }
                Kind::Cosine | Kind::Sine => {}
            }
        }
        if let Some(g) = back.take(0) {
            spend(0, &g);
        }
        for &(row, _, _) in &self.constants {
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

/// The error of a product of which both factors are zero within their errors: first order says nothing of it.
#[inline]
fn lost(x: f64, ex: f64, y: f64, ey: f64) -> f64 {
    if ex >= x.abs() && ey >= y.abs() { ex * ey } else { 0.0 }
}

/// One operation with its rounding and its running error.
#[inline]
fn forward(step: &Step, signs: &[f64], block: &mut BoundedBlock) {
    let BoundedBlock { values, running, roundings, .. } = block;
    let [a, b, c, d] = step.from.map(|row| row as usize);
    let (x, ex) = (values[a], running[a]);
    let mut out = [0.0; FEW];
    let mut rounding = [0.0; FEW];
    let mut carried = [0.0; FEW];
    match step.kind {
        Kind::Sum | Kind::Difference => {
            let sign = if step.kind == Kind::Sum { 1.0 } else { -1.0 };
            let (y, ey) = (&values[b], &running[b]);
            for i in 0..FEW {
                out[i] = x[i] + sign * y[i];
                rounding[i] = U * out[i].abs();
                carried[i] = ex[i] + ey[i];
            }
        }
        Kind::Opposite => {
            for i in 0..FEW {
                out[i] = -x[i];
                carried[i] = ex[i];
            }
        }
        Kind::Product => {
            let (y, ey) = (&values[b], &running[b]);
            for i in 0..FEW {
                out[i] = x[i] * y[i];
                rounding[i] = U * out[i].abs() + lost(x[i], ex[i], y[i], ey[i]);
                carried[i] = x[i].abs() * ey[i] + y[i].abs() * ex[i];
            }
        }
        Kind::Quotient => {
            let (y, ey) = (&values[b], &running[b]);
            let mut inverse = [0.0; FEW];
            for i in 0..FEW {
                inverse[i] = 1.0 / y[i];
                out[i] = x[i] / y[i];
                rounding[i] = U * out[i].abs();
                carried[i] = (ex[i] + out[i].abs() * ey[i]) * inverse[i].abs();
            }
            values[step.second as usize] = inverse;
        }
        Kind::Root | Kind::HalfChord => {
            let sign = match step.kind {
                Kind::HalfChord => signs.get(b).copied().unwrap_or(1.0),
                _ => 1.0,
            };
            let mut inverse = [0.0; FEW];
            for i in 0..FEW {
                out[i] = sign * x[i].max(0.0).sqrt();
                inverse[i] = if out[i] == 0.0 { 0.0 } else { 0.5 / out[i] };
                rounding[i] = U * out[i].abs();
                carried[i] = ex[i] * inverse[i].abs();
            }
            values[step.second as usize] = inverse;
        }
        Kind::Dot | Kind::Cross => {
            let sign = if step.kind == Kind::Dot { 1.0 } else { -1.0 };
            let (y, ey, z, ez, w, ew) =
                (&values[b], &running[b], &values[c], &running[c], &values[d], &running[d]);
            for i in 0..FEW {
                let (xy, zw) = (x[i] * y[i], z[i] * w[i]);
                out[i] = xy + sign * zw;
                rounding[i] = U * (out[i].abs() + xy.abs() + zw.abs())
                    + lost(x[i], ex[i], y[i], ey[i])
                    + lost(z[i], ez[i], w[i], ew[i]);
                carried[i] =
                    x[i].abs() * ey[i] + y[i].abs() * ex[i] + z[i].abs() * ew[i] + w[i].abs() * ez[i];
            }
        }
        Kind::Cosine | Kind::Sine => {
            let mut sines = [0.0; FEW];
            for i in 0..FEW {
                (sines[i], out[i]) = libm::sincos(x[i]);
                rounding[i] = TRANSCENDENTAL * U * out[i].abs();
                carried[i] = sines[i].abs() * ex[i];
            }
            let second = step.second as usize;
            for i in 0..FEW {
                roundings[second][i] = TRANSCENDENTAL * U * sines[i].abs();
                running[second][i] = out[i].abs() * ex[i] + roundings[second][i];
            }
            values[second] = sines;
        }
        Kind::Angle | Kind::Turned => {
            let (y, ey) = (&values[b], &running[b]);
            let mut inverse = [0.0; FEW];
            for i in 0..FEW {
                out[i] = libm::atan2(x[i], y[i]);
                inverse[i] = 1.0 / (x[i] * x[i] + y[i] * y[i]);
                rounding[i] = TRANSCENDENTAL * U * out[i].abs();
                carried[i] = (x[i].abs() * ey[i] + y[i].abs() * ex[i]) * inverse[i];
            }
            values[step.second as usize] = inverse;
        }
    }
    let to = step.to as usize;
    for i in 0..FEW {
        running[to][i] = carried[i] + rounding[i];
    }
    values[to] = out;
    roundings[to] = rounding;
}
