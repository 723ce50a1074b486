//! What is sought elsewhere than at the inputs: by trials, and in proportion.
//!
//! Efforts are linear in what is sought. One unknown is found by two trials: with it at zero and at one unit, and in
//! proportion where the effort vanishes. Of several, each is tried alone; the first one is what takes the effort away
//! from an input that feels it, whatever the others are, and so on to the last, which is found as one alone is.

use crate::board::Amount;
use crate::mechanism::force::{Share, Sought};
use crate::plan::Plan;

use super::super::construction::{Trial, Trials};
use super::super::draughtsman::Draughtsman;
use super::super::missing::Missing;
use super::friction::Leaning;
use super::read::UNBALANCED;
use super::{Balance, NO_SPEED, one, until};

/// The unit of what is sought in which trials are made.
pub(super) const TRIAL: f64 = 1.0;

/// The balance of one share in which this is sought, instead of the efforts.
pub(super) fn found(
    d: &mut Draughtsman<'_>,
    plan: &Plan,
    (share, leaning): (Share, &Leaning),
    named: &[Sought],
) -> Balance {
    let refused = |why: &'static str| Balance { refused: Some(why), ..Balance::default() };
    if named.len() != d.mechanism.inputs.len() {
        return refused("as many loads are sought as there are inputs, or none");
    }
    if named.len() > 1 && named.contains(&Sought::Spin) {
        return refused("this version does not draw a speed that is sought together with loads");
    }
    let rest = d.rest();
    let nothing: Vec<(Sought, Amount)> = named.iter().map(|sought| (*sought, rest)).collect();
    let without = one(d, plan, (share, leaning), nothing.clone());
    if without.refused.is_some() {
        return without;
    }
    // A hand tries one as large as it will be.
    let found = d.tried_sizes.iter().find(|(of, _)| *of == share).filter(|_| named.len() == 1);
    let tried = found.map_or(TRIAL, |(_, size)| *size);
    let unit = d.board.amount(crate::given::Given::exact(tried));
    let Some(first) = efforts(d, &without) else { return without };
    let mut trials = Vec::new();
    for index in 0..named.len() {
        let mut assumed = nothing.clone();
        assumed[index].1 = unit;
        let with = one(d, plan, (share, leaning), assumed);
        match efforts(d, &with) {
            Some(efforts) => trials.push(efforts),
            None => return without,
        }
    }
    let Some(sizes) = in_proportion(d, (&first, &trials), named, (tried != TRIAL).then_some(unit)) else {
        return refused(NO_SPEED);
    };
    let found: Vec<(Sought, Amount)> = named.iter().copied().zip(sizes).collect();
    if let Some(sought) = idle(d, &found) {
        let efforts = found.clone();
        // What rubs hangs on all forces at once.
        if !d.mechanism.forces.friction.is_empty() {
            return Balance { efforts, ..refused(UNBALANCED) };
        }
        return Balance {
            efforts,
            ..until(d, plan, (share, leaning), found, &d.mechanism.loaded_by(sought))
        };
    }
    let mut balance = one(d, plan, (share, leaning), found.clone());
    let values = |efforts: &[Amount]| efforts.iter().map(|effort| effort.value()).collect::<Vec<f64>>();
    match (&found[..], &first[..], &trials[..]) {
        (&[(sought, size)], [none], [all]) => {
            let efforts = [none.value(), all[0].value()];
            balance.trial = Some(Trial { sought, tried, efforts, size: size.value() });
        }
        _ => {
            balance.trials = Some(Trials {
                sought: found.iter().map(|(sought, size)| (*sought, size.value())).collect(),
                tried: TRIAL,
                without: values(&first),
                with: trials.iter().map(|efforts| values(efforts)).collect(),
            });
        }
    }
    balance.efforts = found;
    balance
}

/// What is sought elsewhere than on a driven link and does no work: no size of it brings the links between it and the
/// input into balance. Where the drawing will be run for other places, what never does any.
fn idle(d: &mut Draughtsman<'_>, found: &[(Sought, Amount)]) -> Option<Sought> {
    let runs = d.board.tape().will_be_run();
    let mut elsewhere = found.iter().filter(|(sought, _)| !d.mechanism.is_sought_at_input(*sought));
    let is_idle = |(sought, size): &&(Sought, Amount)| match runs {
        true => d.mechanism.is_always_idle(*sought),
        false => d.board.is_weak(*size),
    };
    elsewhere.find(is_idle).map(|(sought, _)| *sought)
}

/// The effort at every input; none where one was not found.
fn efforts(d: &Draughtsman<'_>, balance: &Balance) -> Option<Vec<Amount>> {
    let of = |input: usize| {
        let mut all = balance.efforts.iter();
        all.find(|(sought, _)| *sought == Sought::Effort(input)).map(|(_, size)| *size)
    };
    (0..d.mechanism.inputs.len()).map(of).collect()
}

/// The sizes with which no input has an effort, from the efforts without anything sought and with a trial of each, of this
/// size where it is not one unit; `None` where a speed would be no number.
fn in_proportion(
    d: &mut Draughtsman<'_>,
    (without, with): (&[Amount], &[Vec<Amount>]),
    named: &[Sought],
    tried: Option<Amount>,
) -> Option<Vec<Amount>> {
    // For each input: what a unit of each unknown changes, and what is there without them.
    let mut rows: Vec<(Vec<Amount>, Amount)> = Vec::new();
    for (input, none) in without.iter().enumerate() {
        let changes = with.iter().map(|efforts| d.board.difference(efforts[input], *none)).collect();
        rows.push((changes, *none));
    }
    let mut told: Vec<(Vec<Amount>, Amount)> = Vec::new();
    for unknown in 0..named.len() {
        // The input that feels it most, beside what else it feels.
        let part = |(changes, _): &(Vec<Amount>, Amount)| {
            let most = changes[unknown..].iter().map(|c| c.value().abs()).fold(0.0, f64::max);
            if most > 0.0 { changes[unknown].value().abs() / most } else { 0.0 }
        };
        let best =
            (0..rows.len()).max_by(|a, b| part(&rows[*a]).total_cmp(&part(&rows[*b])).then(b.cmp(a)))?;
        let (changes, rest) = rows.remove(best);
        let reason = d.reason_missing(Missing::Work(named[unknown]));
        for (others, left) in &mut rows {
            let times = d.board.quotient(others[unknown], changes[unknown], reason);
            for (other, change) in others.iter_mut().zip(&changes).skip(unknown + 1) {
                let taken = d.board.product(times, *change);
                *other = d.board.difference(*other, taken);
            }
            let taken = d.board.product(times, rest);
            *left = d.board.difference(*left, taken);
        }
        told.push((changes, rest));
    }
    let mut sizes: Vec<Amount> = Vec::new();
    for (unknown, (changes, rest)) in told.iter().enumerate().rev() {
        let mut left = *rest;
        for (change, size) in changes.iter().rev().zip(&sizes) {
            let part = d.board.product(*change, *size);
            left = d.board.sum(left, part);
        }
        let reason = d.reason_missing(Missing::Work(named[unknown]));
        let part = d.board.quotient(left, changes[unknown], reason);
        let size = d.board.opposite(part);
        let size = tried.map_or(size, |tried| d.board.product(size, tried));
        sizes.push(match named[unknown] {
            Sought::Spin => d.square_of_a_speed(size, reason)?,
            _ => size,
        });
    }
    sizes.reverse();
    Some(sizes)
}
