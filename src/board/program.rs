//! A drawing as a flat list of slot-indexed operations, to be run for many values of its input.
//!
//! The drawing is made once, and its tape read into a [`Transcript`]. What depends on the input stays
//! an operation; everything else is computed at once and becomes a constant; what is computed twice stands
//! once; what no asked number and no condition needs is left out. A [`Program`] holds no string, no label
//! and no branch, and runs without allocation.
//!
//! What a drawing decides by looking stays as it was in the drawing that was transcribed: which of two
//! meeting points is taken (a sign of [`Program::chords`], which can be turned at a change point), whether a
//! magnitude was taken of a negative number (the program then gives it with either sign), and that no
//! divisor is zero ([`Program::divisors`]), and which turn an angle is in that goes on beyond half a turn
//! ([`Program::turns`]). Whoever runs the program watches them.
//!
//! A transcript may know how uncertain its numbers are ([`Transcript::with_errors`]). Then two numbers of the
//! scene that happen to be equal stay two, and nothing is left out because of what is zero or one only
//! within its error: of such a transcript a [`super::BoundedProgram`] can be made.

use std::collections::HashMap;
use std::f64::consts::PI;

use super::bounded::BoundedProgram;
use super::op::{MOST_OPERANDS, Op};
use super::tape::{self, Event, Leaf, Reason, Role, Tape, Trial};
use super::trial::{CARRIED, Seen, find};
use crate::given::Given;
use crate::lots::lot;

/// Positions that are computed together.
pub const LANES: usize = 16;

/// One number for each of [`LANES`] positions.
pub type Lane = [f64; LANES];

/// Unit roundoff of the doubles in which programs compute.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// A number exceeds its error as a divisor does on the tape.
pub(super) const CLEAR: f64 = 8.0;

/// The operands of a node: slots, unused ones zero. The second of a half chord is its index, the third of an angle
/// that goes on.
pub(super) type Operands = [u32; MOST_OPERANDS];

#[derive(Debug, Clone, Copy)]
pub(super) enum Node {
    /// A number that depends on nothing that is varied, and its error; 0 where nobody keeps errors.
    Constant(f64, f64),
    Input,
    /// What is found by trial, for every place anew.
    Tried,
    Made(Op, Operands),
}

/// A number that a program is to give.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Wanted {
    /// Its mark in the transcript.
    pub slot: u32,
    /// It tells of the mechanism's motion: where a divisor behind it vanishes, the mechanism stands in a dead position.
    /// What is drawn onto the skeleton besides, as instant centres are, may vanish by itself.
    pub of_motion: bool,
}

/// How an input moves in time: from its place and its rate in the drawing, with constant acceleration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Law {
    /// Rate at the drawing's own time, SI units.
    pub rate: Given,
    /// Acceleration, SI units.
    pub acceleration: Given,
}

/// What a program varies.
#[derive(Debug, Clone, PartialEq)]
pub enum Variable {
    /// The place of an input, by its index; rates stay as they are.
    Input(usize),
    /// Time, in seconds from the instant of the drawing: every input moves by its law.
    Time(Vec<Law>),
}

impl Default for Variable {
    fn default() -> Self {
        Self::Input(0)
    }
}

/// A tape read for a program, in the fewest operations that say the same.
#[derive(Debug, Clone, Default)]
pub struct Transcript {
    variable: Variable,
    with_errors: bool,
    pub(super) nodes: Vec<Node>,
    values: Vec<f64>,
    made: HashMap<(Op, Operands), u32>,
    constants: HashMap<u64, u32>,
    /// How far off is what was computed from constants alone, where errors do not stand with the numbers themselves.
    folded: HashMap<u32, f64>,
    pub(super) chords: Vec<u32>,
    chord_calls: Vec<Option<u32>>,
    pub(super) divisors: Vec<(u32, Reason)>,
    /// The angles that go on.
    turns: Vec<u32>,
    turn_calls: Vec<Option<u32>>,
    pub(super) trials: Vec<Trial>,
    /// Of each chord the one on whose sign it hangs: itself, but in a search by trial.
    again: Vec<usize>,
    /// The slot of each mark of the tape.
    slots: Vec<u32>,
}

impl Transcript {
    /// Which chord every half chord of the drawing is, in the order of drawing; `None` for a constant.
    #[must_use]
    pub fn chord_calls(&self) -> &[Option<u32>] {
        &self.chord_calls
    }

    /// Which of the angles that go on every one of the drawing is, in the order of drawing; `None` for a constant.
    #[must_use]
    pub fn turn_calls(&self) -> &[Option<u32>] {
        &self.turn_calls
    }

    /// How an input moves, where time is varied.
    fn law(&self, input: usize) -> Option<Law> {
        match &self.variable {
            Variable::Input(_) => None,
            Variable::Time(laws) => laws.get(input).copied(),
        }
    }

    fn constant(&mut self, value: f64) -> u32 {
        // One zero is enough.
        let value = value + 0.0;
        if let Some(&slot) = self.constants.get(&value.to_bits()) {
            return slot;
        }
        let slot = self.node(Node::Constant(value, 0.0), value);
        self.constants.insert(value.to_bits(), slot);
        slot
    }

    /// A number that is known within `error`: never taken for another one that is equal.
    fn uncertain(&mut self, value: f64, error: f64) -> u32 {
        if !self.with_errors || error == 0.0 {
            return self.constant(value);
        }
        self.node(Node::Constant(value, error), value)
    }

    /// The same where no number has an error of its own: each is off by a few roundings.
    fn folded_noise(&self, op: Op, of: Operands, value: f64) -> f64 {
        let values = of.map(|slot| self.value(slot));
        let partials = op.partials(values, value);
        let own = |i: usize| self.folded.get(&of[i]).copied().unwrap_or(4.0 * U * values[i].abs());
        let carried: f64 = (0..op.operands()).map(|i| partials[i].abs() * own(i)).sum();
        carried + op.rounding::<f64>(values, value)
    }

    /// How far off a constant is: a few roundings, but where nothing else is left of what it was computed from.
    fn noise(&self, slot: usize, value: f64) -> f64 {
        let folded = u32::try_from(slot).ok().and_then(|slot| self.folded.get(&slot).copied());
        folded.filter(|error| value.abs() <= CLEAR * error).unwrap_or(4.0 * U * value.abs())
    }

    /// The error of what is computed from constants alone.
    fn folded_error(&self, op: Op, of: Operands, value: f64) -> f64 {
        let values = of.map(|slot| self.value(slot));
        let errors = of.map(|slot| match self.nodes.get(slot as usize) {
            Some(Node::Constant(_, error)) => *error,
            _ => 0.0,
        });
        let vanishes = |operand: usize| values[operand].abs() <= CLEAR * errors[operand];
        match op {
            Op::Quotient if errors[1] > 0.0 && vanishes(1) => return f64::INFINITY,
            Op::HalfChord if vanishes(0) => return f64::INFINITY,
            Op::Root if vanishes(0) => return (values[0].abs() + errors[0]).sqrt(),
            _ => {}
        }
        let partials = op.partials(values, value);
        let carried: f64 = (0..op.operands())
            .map(|i| if errors[i] > 0.0 { partials[i].abs() * errors[i] } else { 0.0 })
            .sum();
        carried + op.rounding::<f64>(values, value)
    }

    /// The number that is varied.
    fn varied(&mut self, value: f64) -> u32 {
        match self.nodes.iter().position(|n| matches!(n, Node::Input)) {
            Some(slot) => u32::try_from(slot).unwrap_or(u32::MAX),
            None => self.node(Node::Input, value),
        }
    }

    /// Where what is varied stands in the drawing.
    fn place(&self) -> f64 {
        let at = self.nodes.iter().position(|n| matches!(n, Node::Input));
        at.and_then(|slot| self.values.get(slot).copied()).unwrap_or(0.0)
    }

    fn node(&mut self, node: Node, value: f64) -> u32 {
        let slot = u32::try_from(self.nodes.len()).unwrap_or(u32::MAX);
        self.nodes.push(node);
        self.values.push(value);
        slot
    }

    /// The slot of what is computed so.
    pub(super) fn made(&self, op: Op, of: Operands) -> Option<u32> {
        self.made.get(&(op, of)).copied()
    }

    fn known(&self, slot: u32) -> Option<f64> {
        match self.nodes.get(slot as usize) {
            Some(Node::Constant(value, _)) => Some(*value),
            _ => None,
        }
    }

    /// A number that depends on nothing that is varied; `None` for one that does.
    #[must_use]
    pub fn constant_at(&self, mark: u32) -> Option<f64> {
        self.known(mark)
    }

    /// A constant without error.
    fn exactly(&self, slot: u32) -> Option<f64> {
        match self.nodes.get(slot as usize) {
            Some(Node::Constant(value, 0.0)) => Some(*value),
            _ => None,
        }
    }

    fn value(&self, slot: u32) -> f64 {
        self.values.get(slot as usize).copied().unwrap_or(0.0)
    }

    /// Writes an operation down, in the simplest form that comes to the same double.
    fn make(&mut self, op: Op, [a, b, c, d]: Operands) -> u32 {
        let count = op.operands();
        if [a, b, c, d][..count].iter().all(|&slot| self.known(slot).is_some()) {
            return self.fold(op, [a, b, c, d]);
        }
        let number = |slot| self.exactly(slot);
        let is = |slot: u32, value: f64| number(slot) == Some(value);
        match op {
            Op::Sum if is(a, 0.0) => return b,
            Op::Sum | Op::Difference if is(b, 0.0) => return a,
            Op::Difference if is(a, 0.0) => return self.make(Op::Opposite, [b, 0, 0, 0]),
            Op::Difference if a == b => return self.constant(0.0),
            Op::Sum => {
                if let Some(Node::Made(Op::Opposite, [x, ..])) = self.nodes.get(b as usize).copied() {
                    return self.make(Op::Difference, [a, x, 0, 0]);
                }
            }
            Op::Difference => {
                if let Some(Node::Made(Op::Opposite, [x, ..])) = self.nodes.get(b as usize).copied() {
                    return self.make(Op::Sum, [a, x, 0, 0]);
                }
            }
            Op::Product if is(a, 0.0) || is(b, 0.0) => return self.constant(0.0),
            Op::Product if is(a, 1.0) => return b,
            Op::Product | Op::Quotient if is(b, 1.0) => return a,
            Op::Product if is(a, -1.0) => return self.make(Op::Opposite, [b, 0, 0, 0]),
            Op::Product if is(b, -1.0) => return self.make(Op::Opposite, [a, 0, 0, 0]),
            Op::Quotient if is(a, 0.0) => return self.constant(0.0),
            Op::Opposite => {
                if let Some(Node::Made(Op::Opposite, [x, ..])) = self.nodes.get(a as usize) {
                    return *x;
                }
            }
            Op::Dot | Op::Cross => {
                let whole = [[a, b], [c, d]];
                let idle = whole.map(|[p, q]| is(p, 0.0) || is(q, 0.0));
                let plain = whole.map(|[p, q]| is(p, 1.0) || is(q, 1.0));
                if idle[0] || idle[1] || plain[0] || plain[1] {
                    let [first, second] = whole.map(|[p, q]| self.make(Op::Product, [p, q, 0, 0]));
                    let joint = if op == Op::Dot { Op::Sum } else { Op::Difference };
                    return self.make(joint, [first, second, 0, 0]);
                }
            }
            _ => {}
        }
        let operands = match op {
            Op::Sum | Op::Product if b < a => [b, a, 0, 0],
            _ => [a, b, c, d],
        };
        if let Some(&slot) = self.made.get(&(op, operands)) {
            return slot;
        }
        let values = operands.map(|slot| self.value(slot));
        let slot = self.node(Node::Made(op, operands), op.value(values));
        self.made.insert((op, operands), slot);
        slot
    }

    /// What is computed from constants alone is a constant.
    fn fold(&mut self, op: Op, of: Operands) -> u32 {
        let value = op.value(of.map(|slot| self.value(slot)));
        if !self.with_errors {
            let error = self.folded_noise(op, of, value);
            let slot = self.constant(value);
            // A number that stood there already is as sure as it was.
            if slot as usize + 1 == self.nodes.len() && error.is_finite() {
                self.folded.entry(slot).or_insert(error);
            }
            return slot;
        }
        // The same computation of the same numbers has the same error, not one of its own.
        if let Some(&slot) = self.made.get(&(op, of)) {
            return slot;
        }
        let error = self.folded_error(op, of, value);
        let slot = self.uncertain(value, error);
        self.made.insert((op, of), slot);
        slot
    }

    /// The program that computes these numbers with a bound for each.
    #[must_use]
    pub fn bounded(&self, asked: &[u32]) -> BoundedProgram {
        BoundedProgram::new(self, asked)
    }

    /// The program that computes these numbers; with what has to be watched on the way, or without.
    ///
    /// Conditions count only behind an answer: a meet that was drawn for a track that nobody took limits nothing.
    #[must_use]
    pub fn program(&self, asked: &[Wanted], watched: bool) -> Program {
        let behind_any = self.behind_all(asked.iter().map(|wanted| wanted.slot));
        let behind_motion =
            self.behind_all(asked.iter().filter(|wanted| wanted.of_motion).map(|wanted| wanted.slot));
        let is_behind = |reached: &[bool], slot: u32| reached.get(slot as usize).copied().unwrap_or(false);
        let open = |slot: u32| !matches!(self.nodes.get(slot as usize), Some(Node::Constant(..)) | None);
        let live = |slot: u32| watched && open(slot) && is_behind(&behind_any, slot);
        let guards: Vec<(u32, Reason)> = self.divisors.iter().copied().filter(|d| live(d.0)).collect();
        let chords: Vec<(usize, u32)> =
            self.chords.iter().copied().enumerate().filter(|(_, slot)| live(*slot)).collect();
        let turns: Vec<(usize, u32)> =
            self.turns.iter().copied().enumerate().filter(|(_, slot)| live(*slot)).collect();
        let mut guarded = vec![false; self.nodes.len()];
        for &(slot, _) in &guards {
            guarded[slot as usize] = true;
        }
        let mut squares = vec![false; self.nodes.len()];
        for &slot in &self.chords {
            squares[slot as usize] = true;
        }
        let trials: Vec<(usize, Trial)> = self
            .trials
            .iter()
            .copied()
            .enumerate()
            .filter(|(_, trial)| is_behind(&behind_any, trial.corrected))
            .collect();
        let kept: Vec<u32> = asked
            .iter()
            .map(|wanted| wanted.slot)
            .chain(guards.iter().map(|d| d.0))
            .chain(chords.iter().chain(&turns).map(|(_, slot)| *slot))
            .chain(trials.iter().flat_map(|(_, trial)| [trial.miss, trial.corrected]))
            .collect();
        let last_use = self.last_uses(&kept);
        let drawn = self.lots();
        let mut slots = vec![0_u32; self.nodes.len()];
        let mut program = Program {
            steps: Vec::new(),
            constants: Vec::new(),
            rows: 1,
            asked: Vec::new(),
            chord_slots: self.chords.len(),
            turn_slots: self.turns.len(),
            chords: Vec::new(),
            turns: Vec::new(),
            trials: Vec::new(),
            tried_chords: self
                .again
                .iter()
                .enumerate()
                .filter(|(own, drawn)| own != *drawn)
                .map(|(_, drawn)| *drawn)
                .collect(),
            tried_at: self
                .trials
                .iter()
                .map(|trial| {
                    [self.place(), self.value(trial.found), 1.0_f64.copysign(self.value(trial.slope))]
                })
                .collect(),
            divisors: Vec::new(),
        };
        // The first step behind what each trial finds.
        let mut begins = vec![0; self.trials.len()];
        // Rows whose number nobody needs any more: few rows stay in the nearest cache.
        let mut free: Vec<u32> = Vec::new();
        for (slot, node) in self.nodes.iter().enumerate() {
            if last_use[slot] == Use::Never {
                continue;
            }
            let Node::Made(op, of) = *node else {
                match *node {
                    Node::Constant(value, _) => {
                        slots[slot] = program.row();
                        program.constants.push((slots[slot], value, self.noise(slot, value)));
                    }
                    Node::Tried => {
                        slots[slot] = program.row();
                        for (begin, trial) in begins.iter_mut().zip(&self.trials) {
                            if trial.found as usize == slot {
                                *begin = program.steps.len();
                            }
                        }
                    }
                    Node::Input | Node::Made(..) => {}
                }
                continue;
            };
            let mut from = of.map(|slot| slots.get(slot as usize).copied().unwrap_or(0));
            match op {
                Op::HalfChord => from[1] = self.chord_of(of[1]),
                Op::Turned => from[2] = of[2],
                _ => {}
            }
            // Sine and cosine of one angle are computed in one go: the second stands with the first.
            let partner = match op {
                Op::Cosine => self.made.get(&(Op::Sine, of)),
                Op::Sine => self.made.get(&(Op::Cosine, of)),
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
            let guard = guarded[slot];
            program.steps.push(Step { op, to, second, guard, lots: lots(drawn[slot]), from });
            for (index, trial) in trials.iter().filter(|(_, trial)| trial.miss as usize == slot) {
                program.trials.push(Tried {
                    index: *index,
                    steps: [begins[*index], program.steps.len()],
                    miss: to,
                    unit: trial.unit,
                    reason: self.divisors.iter().find(|d| d.0 == trial.slope).map(|d| d.1),
                    ..Tried::default()
                });
            }
            if !trials.is_empty() {
                // What a search needs it needs again with every step.
                continue;
            }
            let mut done: Vec<u32> = of[..op.operands()].to_vec();
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
        program.asked = asked.iter().map(|wanted| slot_of(wanted.slot)).collect();
        for tried in &mut program.trials {
            let trial = self.trials[tried.index];
            [tried.found, tried.slope, tried.corrected] =
                [trial.found, trial.slope, trial.corrected].map(slot_of);
        }
        program.chords = chords
            .into_iter()
            .filter(|&(index, _)| self.chord_of_index(index) == index)
            .map(|(index, slot)| Chord {
                index,
                row: slot_of(slot),
                reason: guards.iter().find(|d| d.0 == slot).map(|d| d.1),
            })
            .collect();
        program.turns = turns.into_iter().map(|(index, slot)| (index, slot_of(slot))).collect();
        let mut divisors: Vec<(u32, Reason)> = guards
            .into_iter()
            .filter(|d| is_behind(&behind_motion, d.0) && !squares[d.0 as usize])
            // Where the slope of a miss vanishes nothing is found beyond: that is a limit.
            .filter(|d| self.trials.iter().all(|trial| trial.slope != d.0))
            .map(|(slot, why)| (slot_of(slot), why))
            .collect();
        divisors.sort_unstable();
        divisors.dedup_by_key(|d| d.0);
        program.divisors = divisors;
        program
    }

    /// A lot for every number, by how it is computed: the same number errs alike in whatever program it stands, so that
    /// two programs of one drawing refuse the same.
    fn lots(&self) -> Vec<u64> {
        let mut drawn: Vec<u64> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            drawn.push(match *node {
                Node::Input => LOT_OF_INPUT,
                Node::Constant(value, _) => lot_of_constant(value),
                Node::Tried => LOT_OF_TRIAL,
                Node::Made(op, of) => {
                    let of = &of[..op.operands()];
                    let lot_of = |operand: &u32| drawn.get(*operand as usize).copied().unwrap_or(0);
                    let own = lot(op as u64);
                    match op {
                        // Their operands stand in no order.
                        Op::Sum | Op::Product => lot(of.iter().map(lot_of).fold(own, u64::wrapping_add)),
                        _ => of.iter().map(lot_of).fold(own, |all, one| lot(all ^ one)),
                    }
                }
            });
        }
        drawn
    }

    /// Which numbers these numbers have been computed from, themselves among them.
    fn behind_all(&self, slots: impl Iterator<Item = u32>) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len()];
        for slot in slots {
            if let Some(reached) = reached.get_mut(slot as usize) {
                *reached = true;
            }
        }
        // Operands stand before what is made of them.
        for slot in (0..self.nodes.len()).rev() {
            if let (true, Node::Made(op, of)) = (reached[slot], self.nodes[slot]) {
                for &operand in &of[..op.operands()] {
                    reached[operand as usize] = true;
                }
            }
        }
        reached
    }

    /// Which numbers a number has been computed from, itself among them.
    pub(super) fn behind(&self, slot: u32) -> Vec<bool> {
        let mut reached = vec![false; self.nodes.len()];
        let mut open = vec![slot];
        while let Some(slot) = open.pop() {
            let Some(seen) = reached.get_mut(slot as usize) else { continue };
            if std::mem::replace(seen, true) {
                continue;
            }
            if let Node::Made(op, of) = self.nodes[slot as usize] {
                open.extend(&of[..op.operands()]);
            }
        }
        reached
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
            if let (true, Node::Made(op, of)) = (uses[slot] != Use::Never, self.nodes[slot]) {
                // What is computed with its partner is computed when the first of them is.
                for &operand in &of[..op.operands()] {
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

impl Transcript {
    /// Reads a tape, for this to be varied.
    #[must_use]
    pub fn of(tape: &Tape, variable: Variable) -> Self {
        Self { variable, ..Self::default() }.read(tape)
    }

    /// The same, for a program that bounds its numbers.
    #[must_use]
    pub fn with_errors(tape: &Tape, variable: Variable) -> Self {
        Self { variable, with_errors: true, ..Self::default() }.read(tape)
    }

    fn read(mut self, tape: &Tape) -> Self {
        // A trial that was given up is no more than numbers.
        let found: Vec<u32> = tape.trials.iter().flat_map(|trial| [trial.found, trial.slope]).collect();
        // How many half chords had been drawn before each mark.
        let mut calls_before = Vec::with_capacity(tape.nodes.len());
        for (mark, node) in (0_u32..).zip(&tape.nodes) {
            calls_before.push(self.chord_calls.len());
            let slot = match node.node() {
                tape::Node::Leaf(leaf) => {
                    let leaf = tape.leaves[leaf as usize];
                    match leaf.role {
                        Role::Tried if found.contains(&mark) => self.node(Node::Tried, leaf.given.value),
                        Role::Given | Role::Slip | Role::Tried => {
                            self.uncertain(leaf.given.value, leaf.error)
                        }
                        Role::Input(index) => self.input(index, &leaf),
                        Role::Rate(index) => self.input_rate(index, &leaf),
                    }
                }
                tape::Node::Made(op, of) => {
                    let count = op.operands();
                    let mut slots = [0; MOST_OPERANDS];
                    for (slot, &mark) in slots.iter_mut().zip(&of[..count]) {
                        *slot = self.slots[mark as usize];
                    }
                    self.write(op, slots)
                }
            };
            self.slots.push(slot);
        }
        for &(at, event) in &tape.events {
            // What is drawn to find the trial is drawn again with what was found.
            let in_search = |trial: &tape::Trial| (trial.found..=trial.slope).contains(&at);
            if let Event::Divisor { slot, reason, .. } = event
                && !tape.trials.iter().any(in_search)
            {
                self.divisors.push((self.slots[slot as usize], reason));
            }
        }
        let slot = |mark: u32| self.slots[mark as usize];
        self.trials = tape.trials.iter().map(|trial| trial.by(slot)).collect();
        self.again = (0..self.chords.len()).collect();
        for trial in &tape.trials {
            let [from, to] = [trial.found, trial.slope].map(|mark| calls_before[mark as usize]);
            for call in from..to {
                let [first, second] =
                    [call, call + to - from].map(|call| self.chord_calls.get(call).copied());
                if let [Some(Some(first)), Some(Some(second))] = [first, second] {
                    self.draw_again(first as usize, second as usize);
                }
            }
        }
        for call in self.chord_calls.iter_mut().flatten() {
            *call = u32::try_from(self.again[*call as usize]).unwrap_or(u32::MAX);
        }
        self
    }

    /// Notes that a half chord of a search is the same as one of the drawing that follows, so that both stand on one
    /// side.
    fn draw_again(&mut self, of_search: usize, of_drawing: usize) {
        /// Squares of the same chord differ by no more than this part.
        const SAME: f64 = 1e-4;
        let [a, b] = [of_search, of_drawing].map(|chord| self.value(self.chords[chord]));
        if (a - b).abs() <= SAME * a.abs().max(b.abs()) {
            self.again[of_search] = of_drawing;
        }
    }

    /// The chord on whose sign a half chord hangs.
    fn chord_of_index(&self, chord: usize) -> usize {
        self.again.get(chord).copied().unwrap_or(chord)
    }

    /// The same, by slots.
    pub(super) fn chord_of(&self, chord: u32) -> u32 {
        u32::try_from(self.chord_of_index(chord as usize)).unwrap_or(u32::MAX)
    }

    /// The slot of what has this mark on the tape.
    #[must_use]
    pub fn slot(&self, mark: u32) -> u32 {
        self.slots.get(mark as usize).copied().unwrap_or(u32::MAX)
    }

    fn input(&mut self, index: usize, leaf: &Leaf) -> u32 {
        let (value, error) = (leaf.given.value, leaf.error);
        let law = match self.variable {
            Variable::Input(swept) if swept == index => return self.varied(value),
            Variable::Input(_) => None,
            Variable::Time(_) => self.law(index),
        };
        let place = self.uncertain(value, error);
        let Some(law) = law else { return place };
        // s + (v + a/2 t) t
        let half = self.uncertain(law.acceleration.value / 2.0, law.acceleration.error / 2.0);
        let rate = self.uncertain(law.rate.value, law.rate.error);
        let time = self.varied(0.0);
        let gained = self.make(Op::Product, [half, time, 0, 0]);
        let mean = self.make(Op::Sum, [rate, gained, 0, 0]);
        let way = self.make(Op::Product, [mean, time, 0, 0]);
        self.make(Op::Sum, [place, way, 0, 0])
    }

    fn input_rate(&mut self, index: usize, leaf: &Leaf) -> u32 {
        let Some(law) = self.law(index) else { return self.uncertain(leaf.given.value, leaf.error) };
        // v + a t
        let rate = self.uncertain(law.rate.value, law.rate.error);
        let acceleration = self.uncertain(law.acceleration.value, law.acceleration.error);
        let time = self.varied(0.0);
        let gained = self.make(Op::Product, [acceleration, time, 0, 0]);
        self.make(Op::Sum, [rate, gained, 0, 0])
    }

    /// Writes an operation of the tape down; angles that go on and half chords are numbered.
    fn write(&mut self, op: Op, mut of: Operands) -> u32 {
        match op {
            Op::Turned => {
                if of[..2].iter().all(|&slot| self.known(slot).is_some()) {
                    self.turn_calls.push(None);
                    return self.fold(Op::Angle, of);
                }
                let before = self.turns.iter().copied().find(|&slot| {
                    matches!(self.nodes.get(slot as usize),
                             Some(Node::Made(Op::Turned, before)) if before[..2] == of[..2])
                });
                if let Some(slot) = before {
                    let index = self.turns.iter().position(|turn| *turn == slot);
                    self.turn_calls.push(index.and_then(|index| u32::try_from(index).ok()));
                    return slot;
                }
                of[2] = u32::try_from(self.turns.len()).unwrap_or(u32::MAX);
                self.turn_calls.push(Some(of[2]));
                let slot = self.make(Op::Turned, of);
                self.turns.push(slot);
                return slot;
            }
            Op::HalfChord => {
                if self.known(of[0]).is_some() {
                    self.chord_calls.push(None);
                    return self.fold(Op::HalfChord, of);
                }
                let index = self.chords.iter().position(|&square| square == of[0]);
                let index = index.unwrap_or_else(|| {
                    self.chords.push(of[0]);
                    self.chords.len() - 1
                });
                of[1] = u32::try_from(index).unwrap_or(u32::MAX);
                self.chord_calls.push(Some(of[1]));
            }
            _ => {}
        }
        self.make(op, of)
    }
}

/// The angle of the vector (x, y) that is within half a turn of so many half turns.
pub(super) fn angle_near(half_turns: f64, y: f64, x: f64) -> f64 {
    let odd = half_turns.rem_euclid(2.0) == 1.0;
    PI * half_turns + if odd { libm::atan2(-y, -x) } else { libm::atan2(y, x) }
}

/// One number by one operation, with the sign of its chord.
pub(super) fn signed(op: Op, values: [f64; MOST_OPERANDS], sign: f64) -> f64 {
    let value = op.value(values);
    if op == Op::HalfChord { sign * value } else { value }
}

#[derive(Debug, Clone, Copy)]
struct Step {
    op: Op,
    to: u32,
    /// Where the sine of a cosine (or the cosine of a sine) goes; 0 where nobody wants it.
    second: u32,
    /// It is divided by: where it does not exceed its error, nothing that follows from it is known.
    guard: bool,
    /// The signs that were drawn for its roundings.
    lots: u8,
    from: [u32; 4],
}

/// A half chord to be watched.
#[derive(Debug, Clone, Copy)]
struct Chord {
    /// Its place among the signs.
    index: usize,
    /// The row of its square.
    row: u32,
    reason: Option<Reason>,
}

/// An open constraint that is met by trial; rows.
#[derive(Debug, Clone, Copy, Default)]
struct Tried {
    /// Its place among the trials of the drawing.
    index: usize,
    /// The steps from what is tried to the miss.
    steps: [usize; 2],
    found: u32,
    miss: u32,
    slope: u32,
    corrected: u32,
    unit: f64,
    /// The reason that was noted with the slope of its miss.
    reason: Option<Reason>,
}

/// For each trial so many numbers stand among the signs: a place of what is varied, where what is tried stands there, how
/// it moves on, and in which sense its miss changes with it.
const OF_TRIAL: usize = 4;

/// Where a trial stands at one place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standing {
    /// The place of its four numbers among the signs: a place of what is varied, where what is tried stands there, how
    /// it moves on, and in which sense its miss changes with it.
    pub index: usize,
    /// Where what is tried stands; not a number where no place near the expected one meets the constraint.
    pub at: Dual,
    /// In which sense its miss changes with it, 1 or −1.
    pub sense: f64,
    /// How far from where its numbers let one expect it, in units of how far it may go at once; infinite in another
    /// assembly.
    pub strayed: f64,
    /// The reason that was noted with the slope of its miss: where that vanishes nothing is found beyond.
    pub reason: Option<Reason>,
}

/// What a trial found at one place, for a [`super::BoundedProgram`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FoundByTrial {
    /// Where what is tried stands; not a number where nothing was found.
    pub at: f64,
    /// How the miss changes there.
    pub slope: f64,
    /// How far the slope may be off.
    pub slope_error: f64,
}

impl Default for FoundByTrial {
    /// Nothing.
    fn default() -> Self {
        Self { at: f64::NAN, slope: f64::NAN, slope_error: f64::INFINITY }
    }
}

/// A transcribed drawing.
#[derive(Debug, Clone)]
pub struct Program {
    steps: Vec<Step>,
    /// Rows, values and errors.
    constants: Vec<(u32, f64, f64)>,
    /// Row 0 is the input.
    rows: u32,
    asked: Vec<u32>,
    /// How many half chords the drawing had, those among them that nobody watches.
    chord_slots: usize,
    /// How many angles that go on.
    turn_slots: usize,
    chords: Vec<Chord>,
    /// By their place among the half turns.
    turns: Vec<(usize, u32)>,
    /// In the order of drawing.
    trials: Vec<Tried>,
    /// The chords on whose signs those of a search hang, by their place among the signs.
    tried_chords: Vec<usize>,
    /// For each trial of the drawing: where what is varied stood, what was found there, and in which sense its miss
    /// changed.
    tried_at: Vec<[f64; 3]>,
    /// Behind numbers of motion, half chords not among them.
    divisors: Vec<(u32, Reason)>,
}

/// A number of a program that is looked for by itself, by its place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum LookedFor {
    /// One of [`Program::asked`].
    Asked(usize),
    /// One of [`Program::divisors`].
    Divisor(usize),
}

/// The part of a program that leads to some of its numbers. In a long chain that is little of it.
#[derive(Debug, Clone)]
pub struct Excerpt<'p, const N: usize> {
    program: &'p Program,
    /// Rows, values and errors of the constants that are read.
    constants: Vec<(u32, f64, f64)>,
    /// In the order of drawing; `None` where something is tried: a search needs the steps as they stand.
    steps: Option<Vec<Step>>,
    /// Where the numbers stand.
    rows: [u32; N],
}

/// A number and its derivative by the input, without an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moving {
    /// The number.
    pub value: f64,
    /// Its derivative by the input.
    pub slope: f64,
}

impl<const N: usize> Excerpt<'_, N> {
    /// Computes the numbers at one position, to the same doubles as [`Program::look`]; but where two arcs just touch, which
    /// only their errors tell.
    pub fn look(&self, input: f64, signs: &[f64], place: &mut Workspace) -> [Moving; N] {
        let Some(steps) = &self.steps else {
            self.program.look(input, signs, place);
            return self.rows.map(|row| {
                let Row { value, slope, .. } = place.rows[row as usize];
                Moving { value, slope }
            });
        };
        place.looks += 1;
        place.operations += steps.len() as u64;
        let Workspace { values, slopes, .. } = place;
        // What is read has been written before; what an earlier look left elsewhere is not read.
        values.resize(self.program.rows as usize, [0.0]);
        slopes.resize(self.program.rows as usize, [0.0]);
        (values[0], slopes[0]) = ([input], [1.0]);
        for &(row, value, _) in &self.constants {
            (values[row as usize], slopes[row as usize]) = ([value], [0.0]);
        }
        self.program.run_with_slopes(steps, signs, values, slopes);
        self.rows.map(|row| {
            let ([value], [slope]) = (values[row as usize], slopes[row as usize]);
            Moving { value, slope }
        })
    }

    /// The numbers at one position with their errors, to the same doubles as [`Program::look`].
    pub fn look_closely(&self, input: f64, signs: &[f64], place: &mut Workspace) -> [Dual; N] {
        let Some(steps) = &self.steps else {
            self.program.look(input, signs, place);
            return self.rows.map(|row| place.rows[row as usize].moving());
        };
        place.looks += 1;
        place.operations += steps.len() as u64;
        // As above: what is read has been written before.
        place.rows.resize(self.program.rows as usize, Row::default());
        place.rows[0] = input_row(input, 2.0 * U * input.abs());
        for &(row, value, error) in &self.constants {
            place.rows[row as usize] = constant_row(value, error);
        }
        self.program.look_at_steps(steps, signs, &mut place.rows);
        self.rows.map(|row| place.rows[row as usize].moving())
    }
}

/// The row of what is varied, with its error.
fn input_row(value: f64, error: f64) -> Row {
    let mut row = Row { value, slope: 1.0, ..Row::default() };
    row.round(error, lots(LOT_OF_INPUT));
    row
}

/// The row of a constant, which has been computed from numbers of the scene.
fn constant_row(value: f64, error: f64) -> Row {
    let mut row = Row { value, ..Row::default() };
    row.round(error, lots(lot_of_constant(value)));
    row
}

/// A number, how it changes with the input, and to first order how far rounding may have put it off.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Dual {
    /// The number.
    pub value: f64,
    /// Its derivative by the input.
    pub slope: f64,
    /// How far rounding puts it off, to first order: three times what eight samples of roundings come to in the mean.
    pub error: f64,
}

/// So many samples of the roundings are carried along.
const SAMPLES: usize = 8;

/// A number of one position.
///
/// Its error is carried as samples: in each, every operation has its own rounding with a sign that is drawn by lot, once
/// and for all, and what reaches a number by two ways cancels as it does in the number itself. A running bound grows
/// several-fold with every group, and beyond some ten of them would take a healthy chain for noise; the sharp bound is a
/// sweep back for each number (`bounded.rs`), too dear for every position.
#[derive(Debug, Clone, Copy, Default)]
struct Row {
    value: f64,
    slope: f64,
    errors: [f64; SAMPLES],
    /// A divisor behind it does not exceed its error.
    lost: bool,
}

impl Row {
    fn error(&self) -> f64 {
        /// So many times the mean.
        const TIMES: f64 = 3.0;
        let squares: f64 = self.errors.iter().map(|e| e * e).sum();
        #[expect(clippy::cast_precision_loss, reason = "eight")]
        let samples = SAMPLES as f64;
        TIMES * (squares / samples).sqrt()
    }

    fn moving(&self) -> Dual {
        Dual { value: self.value, slope: self.slope, error: self.error() }
    }

    fn is_clear(&self) -> bool {
        self.value.abs() > CLEAR * self.error()
    }

    /// Adds an operation's own rounding to every sample.
    fn round(&mut self, by: f64, lots: u8) {
        for (index, error) in self.errors.iter_mut().enumerate() {
            *error += if lots >> index & 1 == 0 { by } else { -by };
        }
    }
}

/// The signs that were drawn for the roundings of a number with this lot.
fn lots(lot: u64) -> u8 {
    (lot >> 56) as u8
}

/// The lot of the input.
const LOT_OF_INPUT: u64 = 0xE220_A839_7B1D_CDAF;

/// The lot of what is found by trial.
const LOT_OF_TRIAL: u64 = 0x9FB2_1C65_1E98_DF25;

/// The lot of a constant.
fn lot_of_constant(value: f64) -> u64 {
    lot(value.to_bits())
}

/// Room for a block of positions.
#[derive(Debug, Clone)]
pub struct Block {
    rows: Vec<Lane>,
    /// How the numbers change with what is tried; empty where nothing is.
    slopes: Vec<Lane>,
}

impl Block {
    /// The asked numbers, in order.
    pub fn asked<'a>(&'a self, program: &'a Program) -> impl Iterator<Item = &'a Lane> {
        program.asked.iter().map(|&row| &self.rows[row as usize])
    }
}

/// Room for one position.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    rows: Vec<Row>,
    /// By the trials of the drawing.
    found: Vec<FoundByTrial>,
    /// What a search works on.
    values: Vec<[f64; 1]>,
    slopes: Vec<[f64; 1]>,
    looks: u64,
    operations: u64,
}

impl Workspace {
    /// How many positions have been looked at in this room: what a search has cost.
    #[must_use]
    pub fn looks(&self) -> u64 {
        self.looks
    }

    /// How many operations that were computed in this room, those of searches by trial left out.
    #[must_use]
    pub fn operations(&self) -> u64 {
        self.operations
    }

    /// What every trial of the drawing found at the place that was looked at last, for a [`super::BoundedProgram`].
    #[must_use]
    pub fn found(&self) -> &[FoundByTrial] {
        &self.found
    }
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

    /// Whether nothing depends on the input.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.steps.is_empty()
    }

    /// How many chords (meets of arcs, or of a line with an arc) it draws.
    #[must_use]
    pub fn chord_count(&self) -> usize {
        self.chord_slots
    }

    /// The signs of the drawing that was transcribed: 1 for each chord, and no half turn for each angle that goes on.
    #[must_use]
    pub fn signs(&self) -> Vec<f64> {
        let mut signs = vec![1.0; self.chord_slots];
        signs.resize(self.chord_slots + self.turn_slots, 0.0);
        signs.extend(self.tried_at.iter().flat_map(|&[place, found, sense]| [place, found, 0.0, sense]));
        signs
    }

    /// The signs of chords and the half turns, without what is tried.
    #[must_use]
    pub fn sides<'s>(&self, signs: &'s [f64]) -> &'s [f64] {
        signs.get(..self.chord_slots + self.turn_slots).unwrap_or(signs)
    }

    /// The signs of the same mechanism where what is varied counts from another zero, as after a whole turn.
    #[must_use]
    pub fn shifted(&self, signs: &[f64], by: f64) -> Vec<f64> {
        let mut shifted = signs.to_vec();
        for place in shifted.iter_mut().skip(self.chord_slots + self.turn_slots).step_by(OF_TRIAL) {
            *place += by;
        }
        shifted
    }

    /// Whether anything is found by trial.
    #[must_use]
    pub fn tries(&self) -> bool {
        !self.trials.is_empty()
    }

    /// Whether a chord, by its place among the signs, is one of a dyad inside a trial: where it vanishes the trial may be at
    /// a dead centre, and not the mechanism.
    #[must_use]
    pub fn is_of_trial(&self, chord: usize) -> bool {
        self.tried_chords.contains(&chord)
    }

    /// Where the numbers of a trial stand among the signs.
    fn numbers_of(&self, trial: &Tried) -> usize {
        self.chord_slots + self.turn_slots + OF_TRIAL * trial.index
    }

    /// In which sense a trial's miss changes in this assembly.
    fn sense(&self, trial: &Tried, signs: &[f64]) -> f64 {
        signs.get(self.numbers_of(trial) + 3).copied().unwrap_or(f64::NAN)
    }

    /// Where a trial is expected to stand.
    fn expected(&self, trial: &Tried, signs: &[f64], input: f64) -> f64 {
        match signs.get(self.numbers_of(trial)..) {
            Some(&[place, found, rate, ..]) => found + rate * (input - place),
            _ => f64::NAN,
        }
    }

    /// Near how many half turns the angle of this index is.
    fn half_turns(&self, index: u32, signs: &[f64]) -> f64 {
        signs.get(self.chord_slots + index as usize).copied().unwrap_or(0.0)
    }

    /// Room for blocks of positions, with the constants in place.
    #[must_use]
    pub fn block(&self) -> Block {
        let mut rows = vec![[0.0; LANES]; self.rows as usize];
        for &(row, value, _) in &self.constants {
            rows[row as usize] = [value; LANES];
        }
        let slopes = if self.tries() { vec![[0.0; LANES]; self.rows as usize] } else { Vec::new() };
        Block { rows, slopes }
    }

    /// Computes a block of positions. `signs` has one number, 1 or −1, for each chord: −1 takes the other
    /// meeting point than the drawing that was transcribed; then, for each angle that goes on, the number of half turns
    /// that it is near.
    pub fn run(&self, inputs: &Lane, signs: &[f64], block: &mut Block) {
        let Block { rows, slopes } = block;
        rows[0] = *inputs;
        let mut done = 0;
        for trial in &self.trials {
            let from = trial.steps[0];
            self.run_steps(&self.steps[done..from], signs, rows);
            let expected = inputs.map(|input| self.expected(trial, signs, input));
            self.search(trial, &expected, signs, rows, slopes);
            done = from;
        }
        self.run_steps(&self.steps[done..], signs, rows);
    }

    /// Finds where a trial stands, near where it is expected, and how its miss changes there.
    fn search<const N: usize>(
        &self,
        trial: &Tried,
        expected: &[f64; N],
        signs: &[f64],
        rows: &mut [[f64; N]],
        slopes: &mut [[f64; N]],
    ) {
        let [from, to] = trial.steps;
        let mut look = |at: &[f64; N]| {
            rows[trial.found as usize] = *at;
            slopes[trial.found as usize] = [1.0; N];
            let apart = self.run_with_slopes(&self.steps[from..to], signs, rows, slopes);
            Seen { miss: [rows[trial.miss as usize], slopes[trial.miss as usize]], apart }
        };
        let found = find(expected, &[self.sense(trial, signs); N], trial.unit, &mut look);
        let [_, slope] = look(&found).miss;
        rows[trial.slope as usize] = slope;
        // What was found counts as a number like any other from here on.
        let made = self.steps[from..to].iter().flat_map(|step| [step.to, step.second]);
        for row in made.chain([trial.found]) {
            slopes[row as usize] = [0.0; N];
        }
    }

    /// Computes some of the steps for a block of positions.
    #[inline]
    fn run_steps(&self, steps: &[Step], signs: &[f64], rows: &mut [Lane]) {
        for step in steps {
            let [a, b, c, d] = step.from;
            let x = rows[a as usize];
            let mut out = [0.0; LANES];
            match step.op {
                Op::Sum => zip(&mut out, &x, &rows[b as usize], |x, y| x + y),
                Op::Difference => zip(&mut out, &x, &rows[b as usize], |x, y| x - y),
                Op::Product => zip(&mut out, &x, &rows[b as usize], |x, y| x * y),
                Op::Quotient => zip(&mut out, &x, &rows[b as usize], |x, y| x / y),
                Op::Opposite => each(&mut out, &x, |x| -x),
                Op::Root => each(&mut out, &x, |x| x.max(0.0).sqrt()),
                Op::HalfChord => {
                    let sign = signs.get(b as usize).copied().unwrap_or(1.0);
                    each(&mut out, &x, |x| sign * x.max(0.0).sqrt());
                }
                Op::Dot => {
                    let (y, z, w) = (&rows[b as usize], &rows[c as usize], &rows[d as usize]);
                    for i in 0..LANES {
                        out[i] = x[i] * y[i] + z[i] * w[i];
                    }
                }
                Op::Cross => {
                    let (y, z, w) = (&rows[b as usize], &rows[c as usize], &rows[d as usize]);
                    for i in 0..LANES {
                        out[i] = x[i] * y[i] - z[i] * w[i];
                    }
                }
                Op::Cosine | Op::Sine => {
                    let mut second = [0.0; LANES];
                    for i in 0..LANES {
                        let (sin, cos) = libm::sincos(x[i]);
                        (out[i], second[i]) = if step.op == Op::Cosine { (cos, sin) } else { (sin, cos) };
                    }
                    if step.second != 0 {
                        rows[step.second as usize] = second;
                    }
                }
                Op::Whole => each(&mut out, &x, libm::floor),
                Op::Angle => zip(&mut out, &x, &rows[b as usize], libm::atan2),
                Op::Turned => {
                    let half_turns = self.half_turns(c, signs);
                    zip(&mut out, &x, &rows[b as usize], |y, x| angle_near(half_turns, y, x));
                }
            }
            rows[step.to as usize] = out;
        }
    }

    /// Computes some of the steps with their slopes, to the same doubles. Gives the least square of a half chord that cannot
    /// be drawn and changes, with its slope; zero where there is none.
    fn run_with_slopes<const N: usize>(
        &self,
        steps: &[Step],
        signs: &[f64],
        rows: &mut [[f64; N]],
        slopes: &mut [[f64; N]],
    ) -> [[f64; N]; 2] {
        let mut apart = [[0.0; N]; 2];
        for step in steps {
            let sign = signs.get(step.from[1] as usize).copied().unwrap_or(1.0);
            let other = if step.op == Op::Cosine { Op::Sine } else { Op::Cosine };
            for i in 0..N {
                let (mut values, mut moves) = ([0.0; MOST_OPERANDS], [0.0; MOST_OPERANDS]);
                for (index, &row) in step.from[..step.op.operands()].iter().enumerate() {
                    (values[index], moves[index]) = (rows[row as usize][i], slopes[row as usize][i]);
                }
                if step.op == Op::HalfChord && values[0] < apart[0][i] && moves[0] != 0.0 {
                    (apart[0][i], apart[1][i]) = (values[0], moves[0]);
                }
                let value = match step.op {
                    Op::Turned => angle_near(self.half_turns(step.from[2], signs), values[0], values[1]),
                    op => signed(op, values, sign),
                };
                let slope = |partials: [f64; MOST_OPERANDS]| {
                    partials.iter().zip(&moves).fold(0.0, |sum, (partial, by)| sum + partial * by)
                };
                rows[step.to as usize][i] = value;
                slopes[step.to as usize][i] = slope(step.op.partials(values, value));
                if step.second != 0 {
                    let value = other.value(values);
                    rows[step.second as usize][i] = value;
                    slopes[step.second as usize][i] = slope(other.partials(values, value));
                }
            }
        }
        apart
    }

    /// The part of it that leads to these numbers.
    #[must_use]
    pub fn excerpt<const N: usize>(&self, sought: [LookedFor; N]) -> Excerpt<'_, N> {
        let rows = sought.map(|number| match number {
            LookedFor::Asked(index) => self.asked[index],
            LookedFor::Divisor(index) => self.divisors[index].0,
        });
        // From the end to the beginning: a row may have held other numbers before.
        let mut is_read = vec![false; self.rows as usize];
        for row in rows {
            is_read[row as usize] = true;
        }
        let steps = (!self.tries()).then(|| {
            let mut steps = Vec::new();
            for step in self.steps.iter().rev() {
                let makes_both = step.second != 0 && is_read[step.second as usize];
                if !makes_both && !is_read[step.to as usize] {
                    continue;
                }
                is_read[step.to as usize] = false;
                if step.second != 0 {
                    is_read[step.second as usize] = false;
                }
                for &row in &step.from[..step.op.operands()] {
                    is_read[row as usize] = true;
                }
                steps.push(*step);
            }
            steps.reverse();
            steps
        });
        let read = self.constants.iter().filter(|(row, ..)| is_read[*row as usize]);
        let constants = read.copied().collect();
        Excerpt { program: self, constants, steps, rows }
    }

    /// Computes one position, with the derivative of every number by the input and its error. The input counts as
    /// uncertain by a unit in its last place, as a number of the scene and its unit do.
    pub fn look(&self, input: f64, signs: &[f64], place: &mut Workspace) {
        self.look_within(input, 2.0 * U * input.abs(), signs, place);
    }

    /// The same where the input is known within an error of its own.
    pub fn look_within(&self, input: f64, error: f64, signs: &[f64], place: &mut Workspace) {
        place.looks += 1;
        place.operations += self.steps.len() as u64;
        place.found.clear();
        let rows = &mut place.rows;
        rows.clear();
        rows.resize(self.rows as usize, Row::default());
        rows[0] = input_row(input, error);
        for &(row, value, error) in &self.constants {
            rows[row as usize] = constant_row(value, error);
        }
        let mut done = 0;
        for trial in &self.trials {
            let from = trial.steps[0];
            self.look_at_steps(&self.steps[done..from], signs, rows);
            let Workspace { values, slopes, .. } = place;
            values.clear();
            values.extend(rows.iter().map(|row| [row.value]));
            slopes.clear();
            slopes.resize(rows.len(), [0.0]);
            let expected = self.expected(trial, signs, input);
            self.search(trial, &[expected], signs, values, slopes);
            let [[at], [slope]] = [trial.found, trial.slope].map(|row| values[row as usize]);
            let slope_error = CARRIED * slope.abs();
            rows[trial.found as usize] = Row { value: at, ..Row::default() };
            let mut slope = Row { value: slope, ..Row::default() };
            slope.round(slope_error, lots(LOT_OF_TRIAL));
            slope.lost = !slope.is_clear();
            rows[trial.slope as usize] = slope;
            place.found.resize(self.tried_at.len(), FoundByTrial::default());
            place.found[trial.index] = FoundByTrial { at, slope: slope.value, slope_error };
            done = from;
        }
        self.look_at_steps(&self.steps[done..], signs, rows);
    }

    /// Computes some of the steps for one position, with derivatives and errors.
    #[inline]
    fn look_at_steps(&self, steps: &[Step], signs: &[f64], rows: &mut [Row]) {
        for step in steps {
            // What is no row (the index of a chord, or of a turn) is not looked at.
            let of = step.from.map(|row| rows.get(row as usize).unwrap_or(&rows[0]));
            let of = &of[..step.op.operands()];
            let sign = signs.get(step.from[1] as usize).copied().unwrap_or(1.0);
            let mut values = [0.0; 4];
            for (value, row) in values.iter_mut().zip(of) {
                *value = row.value;
            }
            if step.op == Op::HalfChord && !of[0].is_clear() {
                // The arcs just touch: what is left of the chord is rounding.
                values[0] = 0.0;
            }
            let value = match step.op {
                Op::Turned => angle_near(self.half_turns(step.from[2], signs), values[0], values[1]),
                op => signed(op, values, sign),
            };
            let products = match step.op {
                Op::Dot | Op::Cross => (values[0] * values[1]).abs() + (values[2] * values[3]).abs(),
                _ => 0.0,
            };
            let mut out = carried(of, &step.op.partials(values, value), value);
            if step.op != Op::Whole {
                out.round(2.0 * U * value.abs() + U * products, step.lots);
            }
            out.lost |= step.guard && !out.is_clear();
            let second = (step.second != 0).then(|| {
                let other = if step.op == Op::Cosine { Op::Sine } else { Op::Cosine };
                let value = other.value(values);
                let mut out = carried(of, &other.partials(values, value), value);
                out.round(2.0 * U * value.abs(), step.lots.rotate_left(3));
                out
            });
            rows[step.to as usize] = out;
            if let Some(second) = second {
                rows[step.second as usize] = second;
            }
        }
    }

    /// Where every trial stands at a place of what is varied that was looked at.
    pub fn standing<'a>(
        &'a self,
        place: &'a Workspace,
        signs: &'a [f64],
    ) -> impl Iterator<Item = Standing> + 'a {
        self.trials.iter().map(move |trial| {
            let at = place.rows[trial.corrected as usize].moving();
            let expected = self.expected(trial, signs, place.rows[0].value);
            let index = self.numbers_of(trial);
            let slope = place.rows[trial.slope as usize].value;
            // Beyond a fold the miss changes the other way: that is another assembly.
            let same = self.sense(trial, signs) * slope > 0.0;
            let strayed = if same { (at.value - expected).abs() / trial.unit } else { f64::INFINITY };
            Standing { index, at, sense: 1.0_f64.copysign(slope), strayed, reason: trial.reason }
        })
    }

    /// The asked numbers of a place, in order.
    pub fn asked<'a>(&'a self, place: &'a Workspace) -> impl Iterator<Item = Dual> + 'a {
        self.asked.iter().map(|&row| place.rows[row as usize].moving())
    }

    /// Whether each asked number is known: every divisor behind it exceeds its error.
    pub fn known<'a>(&'a self, place: &'a Workspace) -> impl Iterator<Item = bool> + 'a {
        self.asked.iter().map(|&row| !place.rows[row as usize].lost)
    }

    /// Square of every watched half chord, negative where the arcs do not meet, with its place among the signs.
    pub fn chords<'a>(&'a self, place: &'a Workspace) -> impl Iterator<Item = (usize, Dual)> + 'a {
        self.chords.iter().map(|chord| (chord.index, place.rows[chord.row as usize].moving()))
    }

    /// How far every watched angle that goes on is from the half turns that it is near, with their place among the signs.
    pub fn turns<'a>(
        &'a self,
        place: &'a Workspace,
        signs: &'a [f64],
    ) -> impl Iterator<Item = (usize, f64)> + 'a {
        self.turns.iter().map(|&(index, row)| {
            let near = signs.get(self.chord_slots + index).copied().unwrap_or(0.0);
            (self.chord_slots + index, place.rows[row as usize].value - PI * near)
        })
    }

    /// Every number that is divided by on the way to a number of motion, half chords not among them.
    pub fn divisors<'a>(&'a self, place: &'a Workspace) -> impl Iterator<Item = Dual> + 'a {
        self.divisors.iter().map(|&(row, _)| place.rows[row as usize].moving())
    }

    /// The reason that was noted with a divisor, by its place among [`Program::divisors`].
    #[must_use]
    pub fn reason_of_divisor(&self, index: usize) -> Option<Reason> {
        self.divisors.get(index).map(|d| d.1)
    }

    /// The reason that was noted with a chord, by its place among [`Program::chords`].
    #[must_use]
    pub fn reason_of_chord(&self, index: usize) -> Option<Reason> {
        self.chords.get(index).and_then(|chord| chord.reason)
    }
}

/// A step of a [`Listing`].
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ListedStep {
    /// The operation.
    pub op: Op,
    /// Its row.
    pub to: u32,
    /// Where the sine of a cosine (or the cosine of a sine) goes; 0 where nobody wants it.
    pub second: u32,
    /// Rows of its operands; the second of a half chord is its place among the signs, the third of an angle that goes on
    /// its place among the half turns. Unused ones are 0.
    pub from: [u32; 4],
    /// The signs that were drawn for its roundings, one bit for each sample.
    pub lots: u8,
    /// It is divided by: where it does not exceed its error, nothing that follows from it is known.
    pub guard: bool,
}

/// An open constraint of a [`Listing`] that is met by trial.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ListedTrial {
    /// Its place among the trials of the drawing: its numbers stand there among the signs, past the half turns.
    pub index: usize,
    /// The steps from what is tried to the miss.
    pub steps: [usize; 2],
    /// The row of where what is tried stands.
    pub found: u32,
    /// The row of the miss.
    pub miss: u32,
    /// The row of how the miss changes.
    pub slope: u32,
    /// How far what is tried may go at once.
    pub unit: f64,
    /// The signs that were drawn for the error of the slope.
    pub lots: u8,
}

/// A program as it is written down for another evaluator: every row is written once. Row 0 is the input.
#[derive(Debug, Clone, PartialEq)]
pub struct Listing {
    /// How many rows there are.
    pub rows: u32,
    /// The signs that were drawn for the rounding of the input.
    pub lots_of_input: u8,
    /// Rows that hold a number from the beginning, with the signs that were drawn for its rounding.
    pub constants: Vec<(u32, f64, u8)>,
    /// Those among them that are off by more than a few roundings, and by how much.
    pub noise: Vec<(u32, f64)>,
    /// The operations, in order.
    pub steps: Vec<ListedStep>,
    /// What is found by trial, in the order of the operations.
    pub trials: Vec<ListedTrial>,
    /// The rows of the asked numbers.
    pub asked: Vec<u32>,
    /// How many signs of half chords stand before the half turns.
    pub chord_slots: usize,
    /// How many half turns stand before what is tried.
    pub turn_slots: usize,
    /// Every watched half chord: its place among the signs, the row of its square, why it may vanish.
    pub chords: Vec<(usize, u32, Option<Reason>)>,
    /// Every watched angle that goes on: its place among the half turns, and its row.
    pub turns: Vec<(usize, u32)>,
    /// What is divided by on the way to a number of motion, with the reason.
    pub divisors: Vec<(u32, Reason)>,
}

impl Program {
    /// The program written down, with no row used twice.
    #[must_use]
    pub fn listing(&self) -> Listing {
        let mut now: Vec<u32> = vec![0; self.rows as usize];
        let mut rows = 1;
        let mut fresh = |now: &mut Vec<u32>, row: u32| {
            now[row as usize] = rows;
            rows += 1;
            rows - 1
        };
        let constants = self
            .constants
            .iter()
            .map(|&(row, value, _)| (fresh(&mut now, row), value, lots(lot_of_constant(value))))
            .collect();
        let is_noise = |&&(_, value, error): &&(u32, f64, f64)| error != 4.0 * U * value.abs();
        let noise = self
            .constants
            .iter()
            .filter(is_noise)
            .map(|&(row, _, error)| (now[row as usize], error))
            .collect();
        for trial in &self.trials {
            fresh(&mut now, trial.found);
            fresh(&mut now, trial.slope);
        }
        let steps = self
            .steps
            .iter()
            .map(|step| {
                let mut from = [0; 4];
                for (index, (to, &row)) in from.iter_mut().zip(&step.from).enumerate() {
                    let is_row = index < step.op.operands();
                    let is_place = matches!((step.op, index), (Op::HalfChord, 1) | (Op::Turned, 2));
                    if is_row {
                        *to = now[row as usize];
                    } else if is_place {
                        *to = row;
                    }
                }
                let to = fresh(&mut now, step.to);
                let second = if step.second == 0 { 0 } else { fresh(&mut now, step.second) };
                ListedStep { op: step.op, to, second, from, lots: step.lots, guard: step.guard }
            })
            .collect();
        let row = |row: u32| now[row as usize];
        Listing {
            lots_of_input: lots(LOT_OF_INPUT),
            constants,
            noise,
            steps,
            trials: self
                .trials
                .iter()
                .map(|trial| ListedTrial {
                    index: trial.index,
                    steps: trial.steps,
                    found: row(trial.found),
                    miss: row(trial.miss),
                    slope: row(trial.slope),
                    unit: trial.unit,
                    lots: lots(LOT_OF_TRIAL),
                })
                .collect(),
            asked: self.asked.iter().map(|&asked| row(asked)).collect(),
            chord_slots: self.chord_slots,
            turn_slots: self.turn_slots,
            chords: self.chords.iter().map(|c| (c.index, row(c.row), c.reason)).collect(),
            turns: self.turns.iter().map(|&(index, turn)| (index, row(turn))).collect(),
            divisors: self.divisors.iter().map(|&(divisor, why)| (row(divisor), why)).collect(),
            rows,
        }
    }
}

/// A number with what its operands bring.
fn carried(of: &[&Row], partials: &[f64; 4], value: f64) -> Row {
    let mut out = Row { value, ..Row::default() };
    for (partial, part) in partials.iter().zip(of) {
        out.slope += partial * part.slope;
        for (error, by) in out.errors.iter_mut().zip(&part.errors) {
            *error += partial * by;
        }
        out.lost |= part.lost;
    }
    out
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
