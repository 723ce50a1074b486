//! A drawing as a flat list of slot-indexed operations, to be run for many values of its input.
//!
//! The drawing is made once on a board whose recorder is a [`Transcript`]. What hangs on the input becomes
//! an operation; everything else is reckoned at once and becomes a constant; what is reckoned twice stands
//! once; what no asked number and no condition needs is left out. A [`Program`] holds no string, no label
//! and no branch, and runs without allocation.
//!
//! What a drawing decides by looking stays as it was in the drawing that was transcribed: which of two
//! meeting points is taken (a sign of [`Program::chords`], which can be turned at a change point), whether a
//! magnitude was taken of a negative number (the program then gives it with either sign), and that no
//! divisor is zero ([`Program::divisors`]). Whoever runs the program watches them.

use std::collections::HashMap;

use super::tape::{Operation, Reason, Reckoning, Recorder};

/// Positions that are reckoned together.
pub const LANES: usize = 16;

/// One number for each of [`LANES`] positions.
pub type Lane = [f64; LANES];

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Kind {
    Sum,
    Difference,
    Opposite,
    Product,
    Quotient,
    Root,
    /// ±√a; the sign is that of the chord.
    HalfChord,
    Dot,
    Cross,
    Cosine,
    Sine,
    Angle,
}

/// The operands of a node: slots, unused ones zero. The second of a half chord is its index.
type Operands = [u32; 4];

#[derive(Debug, Clone, Copy)]
enum Node {
    Constant(f64),
    Input,
    Made(Kind, Operands),
}

/// The recorder that writes a drawing down as a program.
#[derive(Debug, Clone, Default)]
pub struct Transcript {
    swept: usize,
    nodes: Vec<Node>,
    values: Vec<f64>,
    made: HashMap<(Kind, Operands), u32>,
    constants: HashMap<u64, u32>,
    chords: Vec<u32>,
    divisors: Vec<(u32, Reason)>,
}

impl Transcript {
    /// For a drawing in which this input (by its index) will be varied.
    #[must_use]
    pub fn of_input(swept: usize) -> Self {
        Self { swept, ..Self::default() }
    }

    fn constant(&mut self, value: f64) -> u32 {
        // One zero is enough.
        let value = value + 0.0;
        if let Some(&slot) = self.constants.get(&value.to_bits()) {
            return slot;
        }
        let slot = self.node(Node::Constant(value), value);
        self.constants.insert(value.to_bits(), slot);
        slot
    }

    fn node(&mut self, node: Node, value: f64) -> u32 {
        let slot = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        self.nodes.push(node);
        self.values.push(value);
        slot
    }

    fn known(&self, slot: u32) -> Option<f64> {
        match self.nodes.get(slot as usize) {
            Some(Node::Constant(value)) => Some(*value),
            _ => None,
        }
    }

    fn value(&self, slot: u32) -> f64 {
        self.values.get(slot as usize).copied().unwrap_or(0.0)
    }

    /// Writes an operation down, in the simplest form that says the same.
    fn make(&mut self, kind: Kind, [a, b, c, d]: Operands) -> u32 {
        let number = |slot| self.known(slot);
        let count = operands(kind);
        if [a, b, c, d][..count].iter().all(|&slot| number(slot).is_some()) && kind != Kind::HalfChord {
            let value = reckon(kind, [a, b, c, d].map(|slot| self.value(slot)), 1.0);
            return self.constant(value);
        }
        let is = |slot: u32, value: f64| number(slot) == Some(value);
        match kind {
            Kind::Sum if is(a, 0.0) => return b,
            Kind::Sum | Kind::Difference if is(b, 0.0) => return a,
            Kind::Difference if is(a, 0.0) => return self.make(Kind::Opposite, [b, 0, 0, 0]),
            Kind::Difference if a == b => return self.constant(0.0),
            Kind::Sum => {
                if let Some(Node::Made(Kind::Opposite, [x, ..])) = self.nodes.get(b as usize).copied() {
                    return self.make(Kind::Difference, [a, x, 0, 0]);
                }
            }
            Kind::Difference => {
                if let Some(Node::Made(Kind::Opposite, [x, ..])) = self.nodes.get(b as usize).copied() {
                    return self.make(Kind::Sum, [a, x, 0, 0]);
                }
            }
            Kind::Product if is(a, 0.0) || is(b, 0.0) => return self.constant(0.0),
            Kind::Product if is(a, 1.0) => return b,
            Kind::Product | Kind::Quotient if is(b, 1.0) => return a,
            Kind::Product if is(a, -1.0) => return self.make(Kind::Opposite, [b, 0, 0, 0]),
            Kind::Product if is(b, -1.0) => return self.make(Kind::Opposite, [a, 0, 0, 0]),
            Kind::Quotient if is(a, 0.0) => return self.constant(0.0),
            Kind::Quotient => {
                // A constant divisor is a factor.
                if let Some(divisor) = number(b) {
                    let factor = self.constant(1.0 / divisor);
                    return self.make(Kind::Product, [a, factor, 0, 0]);
                }
            }
            Kind::Opposite => {
                if let Some(Node::Made(Kind::Opposite, [x, ..])) = self.nodes.get(a as usize) {
                    return *x;
                }
            }
            Kind::Dot | Kind::Cross => {
                let whole = [[a, b], [c, d]];
                let idle = whole.map(|[p, q]| is(p, 0.0) || is(q, 0.0));
                let plain = whole.map(|[p, q]| is(p, 1.0) || is(q, 1.0));
                if idle[0] || idle[1] || plain[0] || plain[1] {
                    let [first, second] = whole.map(|[p, q]| self.make(Kind::Product, [p, q, 0, 0]));
                    let joint = if kind == Kind::Dot { Kind::Sum } else { Kind::Difference };
                    return self.make(joint, [first, second, 0, 0]);
                }
            }
            _ => {}
        }
        let operands = match kind {
            Kind::Sum | Kind::Product if b < a => [b, a, 0, 0],
            _ => [a, b, c, d],
        };
        if let Some(&slot) = self.made.get(&(kind, operands)) {
            return slot;
        }
        let mut values = operands.map(|slot| self.value(slot));
        if kind == Kind::HalfChord {
            values[1] = 0.0;
        }
        let slot = self.node(Node::Made(kind, operands), reckon(kind, values, 1.0));
        self.made.insert((kind, operands), slot);
        slot
    }

    /// The program that reckons these numbers; with every divisor to be watched, or without.
    #[must_use]
    pub fn program(&self, asked: &[u32], watched: bool) -> Program {
        let divisors: &[(u32, Reason)] = if watched { &self.divisors } else { &[] };
        let kept: Vec<u32> = asked
            .iter()
            .copied()
            .chain(divisors.iter().map(|d| d.0))
            .chain(self.chords.iter().copied())
            .collect();
        let last_use = self.last_uses(&kept);
        let mut slots = vec![0_u32; self.nodes.len()];
        let mut program = Program {
            steps: Vec::new(),
            constants: Vec::new(),
            rows: 1,
            asked: Vec::new(),
            chords: Vec::new(),
            divisors: Vec::new(),
        };
        // Rows whose number nobody needs any more: few rows stay in the nearest cache.
        let mut free: Vec<u32> = Vec::new();
        for (slot, node) in self.nodes.iter().enumerate() {
            if last_use[slot] == Use::Never {
                continue;
            }
            let Node::Made(kind, of) = *node else {
                if let Node::Constant(value) = *node {
                    slots[slot] = program.row();
                    program.constants.push((slots[slot], value));
                }
                continue;
            };
            let mut from = of.map(|slot| slots.get(slot as usize).copied().unwrap_or(0));
            if kind == Kind::HalfChord {
                from[1] = of[1];
            }
            // Sine and cosine of one angle are reckoned in one go: the second stands with the first.
            let partner = match kind {
                Kind::Cosine => self.made.get(&(Kind::Sine, of)),
                Kind::Sine => self.made.get(&(Kind::Cosine, of)),
                _ => None,
            };
            let partner = partner.map(|&p| p as usize).filter(|&p| last_use[p] != Use::Never);
            if partner.is_some_and(|p| p < slot) {
                continue;
            }
            let mut row = |program: &mut Program| free.pop().unwrap_or_else(|| program.row());
            let to = row(&mut program);
            slots[slot] = to;
            let second = partner.map_or(0, |p| {
                slots[p] = row(&mut program);
                slots[p]
            });
            program.steps.push(Step { kind, to, second, from });
            let mut done: Vec<u32> = of[..operands(kind)].to_vec();
            done.sort_unstable();
            done.dedup();
            for operand in done {
                let made = matches!(self.nodes[operand as usize], Node::Made(..));
                if made && last_use[operand as usize] == Use::At(slot) {
                    free.push(slots[operand as usize]);
                }
            }
        }
        let slot_of = |slot: u32| slots.get(slot as usize).copied().unwrap_or(0);
        program.asked = asked.iter().map(|&slot| slot_of(slot)).collect();
        program.chords = self.chords.iter().map(|&slot| slot_of(slot)).collect();
        let open = |slot: u32| !matches!(self.nodes.get(slot as usize), Some(Node::Constant(_)) | None);
        program.divisors =
            divisors.iter().filter(|d| open(d.0)).map(|&(slot, why)| (slot_of(slot), why)).collect();
        program.divisors.sort_unstable();
        program.divisors.dedup_by_key(|d| d.0);
        program
    }

    /// Which node is the last to need each number; kept numbers are needed to the end.
    fn last_uses(&self, kept: &[u32]) -> Vec<Use> {
        let mut uses = vec![Use::Never; self.nodes.len()];
        for &slot in kept {
            if let Some(u) = uses.get_mut(slot as usize) {
                *u = Use::End;
            }
        }
        for slot in (0..self.nodes.len()).rev() {
            if let (true, Node::Made(kind, of)) = (uses[slot] != Use::Never, self.nodes[slot]) {
                // What is reckoned with its partner is reckoned when the first of them is.
                for &operand in &of[..operands(kind)] {
                    if uses[operand as usize] == Use::Never {
                        uses[operand as usize] = Use::At(slot);
                    }
                }
            }
        }
        uses
    }
}

/// When a number is needed for the last time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Use {
    Never,
    At(usize),
    End,
}

impl Recorder for Transcript {
    type Mark = u32;

    fn given(&mut self, value: f64, _: f64) -> u32 {
        self.constant(value)
    }

    fn input(&mut self, index: usize, value: f64, _: f64) -> u32 {
        if index != self.swept {
            return self.constant(value);
        }
        match self.nodes.iter().position(|n| matches!(n, Node::Input)) {
            Some(slot) => u32::try_from(slot).unwrap_or(u32::MAX),
            None => self.node(Node::Input, value),
        }
    }

    fn result(&mut self, step: Reckoning, parts: &[(u32, f64)], _: f64) -> u32 {
        let mut of = [0; 4];
        for (to, (mark, _)) in of.iter_mut().zip(parts) {
            *to = *mark;
        }
        let kind = match step {
            Reckoning::Sum => Kind::Sum,
            Reckoning::Difference => Kind::Difference,
            Reckoning::Opposite => Kind::Opposite,
            Reckoning::Product => Kind::Product,
            Reckoning::Quotient => Kind::Quotient,
            Reckoning::Root => Kind::Root,
            Reckoning::Dot => Kind::Dot,
            Reckoning::Cross => Kind::Cross,
            Reckoning::Cosine => Kind::Cosine,
            Reckoning::Sine => Kind::Sine,
            Reckoning::Angle => Kind::Angle,
            Reckoning::HalfChord => {
                if let Some(square) = self.known(of[0]) {
                    return self.constant(if square > 0.0 { square.sqrt() } else { 0.0 });
                }
                let index = self.chords.iter().position(|&square| square == of[0]);
                let index = index.unwrap_or_else(|| {
                    self.chords.push(of[0]);
                    self.chords.len() - 1
                });
                of[1] = u32::try_from(index).unwrap_or(u32::MAX);
                Kind::HalfChord
            }
            Reckoning::Times(factor) => {
                of[1] = self.constant(factor);
                Kind::Product
            }
            Reckoning::Over(divisor) => {
                of[1] = self.constant(divisor);
                Kind::Quotient
            }
        };
        self.make(kind, of)
    }

    fn divisor(&mut self, mark: u32, _: f64, reason: Reason) {
        self.divisors.push((mark, reason));
    }

    fn error(&mut self, _: u32) -> Option<f64> {
        None
    }

    fn stroke(&mut self, _: Operation, _: [f64; 2], _: [u32; 2], _: &'static str) -> [f64; 2] {
        [0.0; 2]
    }
}

/// How many slots an operation takes.
fn operands(kind: Kind) -> usize {
    match kind {
        Kind::Opposite | Kind::Root | Kind::HalfChord | Kind::Cosine | Kind::Sine => 1,
        Kind::Sum | Kind::Difference | Kind::Product | Kind::Quotient | Kind::Angle => 2,
        Kind::Dot | Kind::Cross => 4,
    }
}

/// One number by one operation.
fn reckon(kind: Kind, [a, b, c, d]: [f64; 4], sign: f64) -> f64 {
    match kind {
        Kind::Sum => a + b,
        Kind::Difference => a - b,
        Kind::Opposite => -a,
        Kind::Product => a * b,
        Kind::Quotient => a / b,
        Kind::Root => a.max(0.0).sqrt(),
        Kind::HalfChord => sign * a.max(0.0).sqrt(),
        Kind::Dot => a * b + c * d,
        Kind::Cross => a * b - c * d,
        Kind::Cosine => libm::cos(a),
        Kind::Sine => libm::sin(a),
        Kind::Angle => libm::atan2(a, b),
    }
}

#[derive(Debug, Clone, Copy)]
struct Step {
    kind: Kind,
    to: u32,
    /// Where the sine of a cosine (or the cosine of a sine) goes; 0 where nobody wants it.
    second: u32,
    from: [u32; 4],
}

/// A transcribed drawing.
#[derive(Debug, Clone)]
pub struct Program {
    steps: Vec<Step>,
    constants: Vec<(u32, f64)>,
    /// Row 0 is the input.
    rows: u32,
    asked: Vec<u32>,
    chords: Vec<u32>,
    divisors: Vec<(u32, Reason)>,
}

/// A number, how it changes with the input, and to first order how far rounding may have put it off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Moving {
    /// The number.
    pub value: f64,
    /// Its derivative by the input.
    pub slope: f64,
    /// A running bound of its rounding: it forgets correlations, so it is often too large.
    pub error: f64,
}

/// Room for a block of positions.
#[derive(Debug, Clone)]
pub struct Block {
    rows: Vec<Lane>,
}

impl Block {
    /// The asked numbers, in order.
    pub fn asked<'a>(&'a self, program: &'a Program) -> impl Iterator<Item = &'a Lane> {
        program.asked.iter().map(|&row| &self.rows[row as usize])
    }

    /// Whether every chord of a lane can be drawn.
    #[must_use]
    pub fn closes(&self, program: &Program, lane: usize) -> bool {
        program.chords.iter().all(|&row| self.rows[row as usize][lane] > 0.0)
    }
}

/// Room for one position.
#[derive(Debug, Clone, Default)]
pub struct Place {
    rows: Vec<Moving>,
}

impl Program {
    fn row(&mut self) -> u32 {
        self.rows += 1;
        self.rows - 1
    }

    /// How many operations it has.
    #[must_use]
    pub fn len(&self) -> usize {
        self.steps.len()
    }

    /// Whether nothing hangs on the input.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// How many chords (meets of arcs, or of a line with an arc) it draws.
    #[must_use]
    pub fn chord_count(&self) -> usize {
        self.chords.len()
    }

    /// Room for blocks of positions, with the constants in place.
    #[must_use]
    pub fn block(&self) -> Block {
        let mut rows = vec![[0.0; LANES]; self.rows as usize];
        for &(row, value) in &self.constants {
            rows[row as usize] = [value; LANES];
        }
        Block { rows }
    }

    /// Reckons a block of positions. `signs` has one number, 1 or −1, for each chord: −1 takes the other
    /// meeting point than the drawing that was transcribed.
    pub fn run(&self, inputs: &Lane, signs: &[f64], block: &mut Block) {
        let rows = block.rows.as_mut_slice();
        rows[0] = *inputs;
        for step in &self.steps {
            let [a, b, c, d] = step.from;
            let x = rows[a as usize];
            let mut out = [0.0; LANES];
            match step.kind {
                Kind::Sum => zip(&mut out, &x, &rows[b as usize], |x, y| x + y),
                Kind::Difference => zip(&mut out, &x, &rows[b as usize], |x, y| x - y),
                Kind::Product => zip(&mut out, &x, &rows[b as usize], |x, y| x * y),
                Kind::Quotient => zip(&mut out, &x, &rows[b as usize], |x, y| x / y),
                Kind::Opposite => each(&mut out, &x, |x| -x),
                Kind::Root => each(&mut out, &x, |x| x.max(0.0).sqrt()),
                Kind::HalfChord => {
                    let sign = signs.get(b as usize).copied().unwrap_or(1.0);
                    each(&mut out, &x, |x| sign * x.max(0.0).sqrt());
                }
                Kind::Dot => {
                    let (y, z, w) = (&rows[b as usize], &rows[c as usize], &rows[d as usize]);
                    for i in 0..LANES {
                        out[i] = x[i] * y[i] + z[i] * w[i];
                    }
                }
                Kind::Cross => {
                    let (y, z, w) = (&rows[b as usize], &rows[c as usize], &rows[d as usize]);
                    for i in 0..LANES {
                        out[i] = x[i] * y[i] - z[i] * w[i];
                    }
                }
                Kind::Cosine | Kind::Sine => {
                    let mut second = [0.0; LANES];
                    for i in 0..LANES {
                        let (sin, cos) = libm::sincos(x[i]);
                        (out[i], second[i]) = if step.kind == Kind::Cosine { (cos, sin) } else { (sin, cos) };
                    }
                    if step.second != 0 {
                        rows[step.second as usize] = second;
                    }
                }
                Kind::Angle => zip(&mut out, &x, &rows[b as usize], libm::atan2),
            }
            rows[step.to as usize] = out;
        }
    }

    /// Reckons one position, with the derivative of every number by the input and its running error.
    pub fn look(&self, input: f64, signs: &[f64], place: &mut Place) {
        const U: f64 = f64::EPSILON / 2.0;
        /// A number stands clear of its error as a divisor does on the tape.
        const CLEAR: f64 = 8.0;
        let rows = &mut place.rows;
        rows.clear();
        rows.resize(self.rows as usize, Moving::default());
        rows[0] = Moving { value: input, slope: 1.0, error: 0.0 };
        for &(row, value) in &self.constants {
            // A constant has been reckoned from numbers of the scene: a few roundings.
            rows[row as usize] = Moving { value, slope: 0.0, error: 4.0 * U * value.abs() };
        }
        for step in &self.steps {
            let of = step.from.map(|row| rows.get(row as usize).copied().unwrap_or_default());
            let sign = signs.get(step.from[1] as usize).copied().unwrap_or(1.0);
            let mut values = of.map(|m| m.value);
            if step.kind == Kind::HalfChord && values[0].abs() <= CLEAR * of[0].error {
                // The arcs just touch: what is left of the chord is rounding.
                values[0] = 0.0;
            }
            let value = reckon(step.kind, values, sign);
            let partials = partials(step.kind, values, value);
            let mut out = Moving { value, slope: 0.0, error: 2.0 * U * value.abs() };
            if matches!(step.kind, Kind::Dot | Kind::Cross) {
                out.error += U * ((values[0] * values[1]).abs() + (values[2] * values[3]).abs());
            }
            for (partial, part) in partials.iter().zip(&of[..operands(step.kind)]) {
                out.slope += partial * part.slope;
                out.error += partial.abs() * part.error;
            }
            rows[step.to as usize] = out;
            if step.second != 0 {
                let other = if step.kind == Kind::Cosine { Kind::Sine } else { Kind::Cosine };
                let value = reckon(other, values, 1.0);
                let by = self::partials(other, values, value)[0];
                let error = by.abs() * of[0].error + 2.0 * U * value.abs();
                rows[step.second as usize] = Moving { value, slope: by * of[0].slope, error };
            }
        }
    }

    /// The asked numbers of a place, in order.
    pub fn asked<'a>(&'a self, place: &'a Place) -> impl Iterator<Item = Moving> + 'a {
        self.asked.iter().map(|&row| place.rows[row as usize])
    }

    /// Square of every half chord: negative where the arcs do not meet.
    pub fn chords<'a>(&'a self, place: &'a Place) -> impl Iterator<Item = Moving> + 'a {
        self.chords.iter().map(|&row| place.rows[row as usize])
    }

    /// Every number that is divided by.
    pub fn divisors<'a>(&'a self, place: &'a Place) -> impl Iterator<Item = Moving> + 'a {
        self.divisors.iter().map(|&(row, _)| place.rows[row as usize])
    }

    /// The reason that was noted with a divisor.
    #[must_use]
    pub fn reason_of_divisor(&self, index: usize) -> Option<Reason> {
        self.divisors.get(index).map(|d| d.1)
    }

    /// The reason that was noted with a chord.
    #[must_use]
    pub fn reason_of_chord(&self, index: usize) -> Option<Reason> {
        let row = self.chords.get(index)?;
        self.divisors.iter().find(|d| d.0 == *row).map(|d| d.1)
    }

    /// Whether a divisor is the square of a half chord.
    #[must_use]
    pub fn is_chord(&self, index: usize) -> bool {
        self.divisors.get(index).is_some_and(|d| self.chords.contains(&d.0))
    }
}

fn each(out: &mut Lane, x: &Lane, f: impl Fn(f64) -> f64) {
    for (out, x) in out.iter_mut().zip(x) {
        *out = f(*x);
    }
}

fn zip(out: &mut Lane, x: &Lane, y: &Lane, f: impl Fn(f64, f64) -> f64) {
    for ((out, x), y) in out.iter_mut().zip(x).zip(y) {
        *out = f(*x, *y);
    }
}

/// Derivatives of a result by its operands.
fn partials(kind: Kind, [a, b, c, d]: [f64; 4], value: f64) -> [f64; 4] {
    let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
    match kind {
        Kind::Sum => [1.0, 1.0, 0.0, 0.0],
        Kind::Difference => [1.0, -1.0, 0.0, 0.0],
        Kind::Opposite => [-1.0, 0.0, 0.0, 0.0],
        Kind::Product => [b, a, 0.0, 0.0],
        Kind::Quotient => [finite(1.0 / b), finite(-value / b), 0.0, 0.0],
        Kind::Root | Kind::HalfChord => [finite(0.5 / value), 0.0, 0.0, 0.0],
        Kind::Dot => [b, a, d, c],
        Kind::Cross => [b, a, -d, -c],
        Kind::Cosine => [-libm::sin(a), 0.0, 0.0, 0.0],
        Kind::Sine => [libm::cos(a), 0.0, 0.0, 0.0],
        Kind::Angle => {
            let square = a * a + b * b;
            [finite(b / square), finite(-a / square), 0.0, 0.0]
        }
    }
}
