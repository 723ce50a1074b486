//! The transcribed drawing as JSON: what the page runs.

use serde_json::{Value, json};

use crate::board::{ListedTrial, Listing, Op};

/// The number of an operation in the code of a page.
const fn kind(op: Op) -> u32 {
    match op {
        Op::Sum => 0,
        Op::Difference => 1,
        Op::Opposite => 2,
        Op::Product => 3,
        Op::Quotient => 4,
        Op::Root => 5,
        Op::HalfChord => 6,
        Op::Dot => 7,
        Op::Cross => 8,
        Op::Cosine => 9,
        Op::Sine => 10,
        Op::Angle => 11,
        Op::Turned => 12,
        Op::Whole => 13,
    }
}

/// How many operands an operation of the code has.
const fn operands(op: Op) -> usize {
    match op {
        Op::Opposite | Op::Root | Op::HalfChord | Op::Cosine | Op::Sine | Op::Whole => 1,
        Op::Sum | Op::Difference | Op::Product | Op::Quotient | Op::Angle | Op::Turned => 2,
        Op::Dot | Op::Cross => 4,
    }
}

/// A step that is divided by is told by this, beside the signs of its roundings.
const GUARD: u32 = 256;

/// What is found by trial, among the operations of the code.
const FIND: u32 = 14;

/// Integers for a step.
const WIDTH: usize = 8;

/// The program: eight integers for a step. Before the steps that lead to a miss stands a step that finds where it vanishes.
pub(super) fn json(listing: &Listing) -> Value {
    let mut code = Vec::with_capacity(WIDTH * listing.steps.len());
    for (index, step) in listing.steps.iter().enumerate() {
        for trial in listing.trials.iter().filter(|trial| trial.steps[0] == index) {
            find(trial, &mut code);
        }
        let guard = if step.guard { GUARD } else { 0 };
        code.extend([kind(step.op), step.to, step.second]);
        code.extend(step.from);
        code.push(u32::from(step.lots) + guard);
    }
    let mut program = json!({
        "rows": listing.rows,
        "lots": listing.lots_of_input,
        "constants": listing.constants,
        "code": code,
        "signs": listing.chord_slots,
        "chords": listing.chords,
        "turns": listing.turns,
        "divisors": guards(listing),
    });
    if !listing.noise.is_empty() {
        program["noise"] = json!(listing.noise);
    }
    if !listing.trials.is_empty() {
        program["turned"] = listing.turn_slots.into();
    }
    program
}

/// A step that finds where a miss vanishes: rows of what is tried and of the miss's slope, row of the miss, where the steps
/// that lead to it end, its place among the trials, and how far it may go at once.
fn find(trial: &ListedTrial, code: &mut Vec<u32>) {
    let whole = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
    let end = code.len() + WIDTH * (1 + trial.steps[1] - trial.steps[0]);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "one radian, or ten millimetres"
    )]
    let unit = trial.unit as u32;
    code.extend([FIND, trial.found, trial.slope, trial.miss, whole(end), whole(trial.index), unit]);
    code.push(u32::from(trial.lots));
}

/// The rows that are divided by, or whose root is taken, with the reason: each once.
fn guards(listing: &Listing) -> Vec<(u32, u32)> {
    let mut all = listing.divisors.clone();
    all.extend(listing.chords.iter().filter_map(|&(_, row, why)| Some((row, why?))));
    all.sort_unstable();
    all.dedup_by_key(|(row, _)| *row);
    all
}

/// For each asked number the divisors behind it, by their place among those of the program.
pub(super) fn behind(listing: &Listing) -> Vec<Vec<usize>> {
    let guards = guards(listing);
    let mut sets: Vec<Vec<usize>> = vec![Vec::new(); listing.rows as usize];
    for step in &listing.steps {
        let mut own: Vec<usize> = Vec::new();
        for &row in &step.from[..operands(step.op)] {
            own.extend(&sets[row as usize]);
        }
        if let Ok(guard) = guards.binary_search_by_key(&step.to, |(row, _)| *row) {
            own.push(guard);
        }
        own.sort_unstable();
        own.dedup();
        if step.second != 0 {
            sets[step.second as usize].clone_from(&own);
        }
        sets[step.to as usize] = own;
    }
    listing.asked.iter().map(|&row| sets[row as usize].clone()).collect()
}
