//! Groups of higher class, by the balance of their trials: what a trial leaves open exerts a force of unknown size. Two
//! balances, of the loads alone and of a unit of that force alone, tell what would have to hold the trial driver; nothing
//! does, and in proportion the size is found with which nothing has to.

use crate::board::{Amount, Line};
use crate::given::Given;
use crate::mechanism::LinkId;
use crate::mechanism::force::Sought;
use crate::mechanism::structure::{Closing, Drive, Group, Joint, Trial, TrialDriver};

use super::super::construction::GroupTrial;
use super::super::draughtsman::Draughtsman;
use super::sought::TRIAL;
use super::{About, Balance, Item, Pull, SlideForce, Taken, TakenFor, pulls};

/// What keeps a link from turning acts by the guides of others.
const KNOWN_TURNING: &str =
    "this version has no balance of forces for a group whose links are kept from turning by each other";

/// The balance of a group of higher class.
pub(super) fn higher(d: &mut Draughtsman<'_>, group: &Group, index: usize, balance: &mut Balance) {
    if super::triad::on_legs(d, group, balance) {
        return;
    }
    let toothed = |joint: &Joint| matches!(joint, Joint::Roll(roll) if d.leans_by_teeth(*roll));
    if super::friction::rubs(d) && group.joints.iter().any(toothed) {
        balance.refused = Some(super::rolling::TOOTHED);
        return;
    }
    let trial = d.trial(index);
    if trial.knows_turning() {
        balance.refused = Some(KNOWN_TURNING);
        return;
    }
    let drivers: Vec<TrialDriver> = trial.drivers.iter().map(|(driver, _)| *driver).collect();
    let rest = d.rest();
    let unit = d.board.amount(Given::exact(TRIAL));
    // Nothing but what is tried acts: no loads and nothing from bodies that were balanced before.
    let nothing = Balance {
        known: vec![Vec::new(); balance.known.len()],
        on_free_pins: std::collections::BTreeMap::new(),
        ..balance.clone()
    };
    let efforts = |d: &mut Draughtsman<'_>, from: &Balance, sizes: &[Amount]| {
        let tried = pass(d, &trial, from.clone(), sizes);
        let of = |driver: &TrialDriver| tried.held.iter().find(|(of, _)| of == driver).map(|(_, size)| *size);
        match (tried.refused, drivers.iter().map(of).collect::<Option<Vec<Amount>>>()) {
            (None, Some(efforts)) => Ok(efforts),
            (why, _) => Err(why.unwrap_or("no balance of a trial leads to what would hold it")),
        }
    };
    let links: Vec<LinkId> = trial.groups.iter().flat_map(|group| group.links.iter().copied()).collect();
    let reason = d.reason(&links);
    let mut told = None;
    let sizes = match drivers.len() {
        1 => (|| {
            let [loads] = only(efforts(d, balance, &[rest])?)?;
            let [by_unit] = only(efforts(d, &nothing, &[unit])?)?;
            told = Some([loads.value(), by_unit.value()]);
            Ok(vec![proportion(d, loads, by_unit, reason)])
        })(),
        2 => (|| {
            let [loads, other_loads] = only(efforts(d, balance, &[rest, rest])?)?;
            let [first, other_first] = only(efforts(d, &nothing, &[unit, rest])?)?;
            let [second, other_second] = only(efforts(d, &nothing, &[rest, unit])?)?;
            // The first force is chosen each time so that one driver is not held; the other is by what is left.
            let swap = first.value().abs() < second.value().abs();
            let (a, other_a, b, other_b) = if swap {
                (second, other_second, first, other_first)
            } else {
                (first, other_first, second, other_second)
            };
            let left = |d: &mut Draughtsman<'_>, of: Amount, other: Amount| {
                let size = proportion(d, of, a, reason);
                let more = d.board.product(other_a, size);
                d.board.sum(other, more)
            };
            let (by_loads, by_unit) = (left(d, loads, other_loads), left(d, b, other_b));
            let two = proportion(d, by_loads, by_unit, reason);
            let by_two = d.board.product(b, two);
            let all = d.board.sum(loads, by_two);
            let one = proportion(d, all, a, reason);
            Ok(if swap { vec![two, one] } else { vec![one, two] })
        })(),
        _ => Err(super::groups::NO_BALANCE),
    };
    match sizes {
        Ok(sizes) => {
            let held = std::mem::take(&mut balance.held);
            *balance = pass(d, &trial, balance.clone(), &sizes);
            balance.held = held;
            let rods = trial.drivers.iter().filter_map(|(_, closing)| match closing {
                Closing::Rod { link, .. } => Some(*link),
                _ => None,
            });
            let found = trial.drivers.iter().zip(&sizes);
            balance.group_trials.push(GroupTrial {
                told: 0,
                links: rods.chain(trial.groups.iter().rev().flat_map(|group| group.links.clone())).collect(),
                found: found.map(|((driver, closing), size)| (*driver, *closing, size.value())).collect(),
                efforts: told,
            });
        }
        Err(why) => balance.refused = Some(why),
    }
}

/// So many efforts as there are drivers.
fn only<const N: usize>(efforts: Vec<Amount>) -> Result<[Amount; N], &'static str> {
    efforts.try_into().map_err(|_| "no balance of a trial leads to what would hold it")
}

/// −effort / effort of a unit.
fn proportion(
    d: &mut Draughtsman<'_>,
    loads: Amount,
    by_unit: Amount,
    reason: crate::board::Reason,
) -> Amount {
    let size = d.board.quotient(loads, by_unit, reason);
    d.board.opposite(size)
}

/// One balance through the groups of a trial, with these sizes of what it leaves open.
fn pass(d: &mut Draughtsman<'_>, trial: &Trial, mut balance: Balance, sizes: &[Amount]) -> Balance {
    balance.held.clear();
    for ((_, closing), size) in trial.drivers.iter().zip(sizes) {
        close(d, *closing, *size, &mut balance);
    }
    for group in trial.groups.iter().rev() {
        if balance.refused.is_some() {
            break;
        }
        super::groups::into_balance(d, group, &mut balance);
    }
    balance
}

/// Lays off the force of what a trial leaves open.
fn close(d: &mut Draughtsman<'_>, closing: Closing, size: Amount, balance: &mut Balance) {
    match closing {
        Closing::Rod { link, near, far } => {
            let items = balance.on(link);
            let (at_near, at_far) = (d.touch_at(balance, near, link), d.touch_at(balance, far, link));
            let reason = d.reason(&[link]);
            let (along, _) = d.board.toward(at_far, at_near, reason);
            let mut parts = Vec::new();
            if let Some(moments) = d.moments(&items, at_far) {
                // Moments of the rod about its other end give the part across it.
                let across = d.board.quarter_turn(along);
                let line = Line { through: at_near, along: across };
                let tangential = d.balancing(Some(moments), line, at_far, &[link]);
                parts.push(d.pull_along(across, tangential));
                let others = d.mechanism.parties_at(near);
                if let [one, other] = others[..] {
                    let by = if one == link { other } else { one };
                    let found = TakenFor::Across { pin: near, by, on: link, from: far };
                    balance.taken.push(Taken { links: vec![link], about: About::Point(far), found });
                }
            }
            parts.push(d.pull_along(along, size));
            let head = d.chained(&parts);
            let on_rod = Pull { tail: d.board.origin(), head };
            let mut all = pulls(&items);
            all.push(on_rod);
            let at_other_end = d.closing(&all);
            d.note_pin(balance, near, link, on_rod);
            d.note_pin(balance, far, link, at_other_end);
            balance.balanced.insert(link);
        }
        Closing::Slide { slide, pin } => {
            let sliding = d.sliding(slide, None);
            let items = balance.on_some(sliding.inner);
            let at = d.at(pin);
            let (_, normal) = d.pressing_at(balance, slide, at);
            let of_guide = d.pull_along(normal, size);
            let Some(block) = sliding.inner else {
                d.note_slide(balance, slide, &sliding, pin, SlideForce { pull: of_guide, at, couple: None });
                let item = Item { pull: Some(of_guide), at, couple: None };
                balance.push_on_pin(d, pin, item);
                return;
            };
            let mut all = pulls(&items);
            all.push(of_guide);
            let of_pin = d.closing(&all);
            let mut about = items;
            if Draughtsman::rubs_at(balance, pin) {
                let touch = d.touch_at(balance, pin, block);
                about.push(Item { pull: Some(of_pin), at: touch, couple: None });
            }
            let couple = d.keeping(&about, at);
            d.note_slide(balance, slide, &sliding, pin, SlideForce { pull: of_guide, at, couple });
            d.note_pin(balance, pin, block, of_pin);
            balance.balanced.insert(block);
        }
        Closing::Angle { link, input } => {
            let Some(&joint) = d.mechanism.link(link).points.first() else {
                balance.refused = Some("a driven link has no joint");
                return;
            };
            let at = d.at(joint);
            balance.known[link.0].push(Item { pull: None, at, couple: Some(size) });
            balance.efforts.push((Sought::Effort(input), size));
        }
        Closing::Driven { slide, pin, input } => {
            let pair = d.mechanism.slides[slide];
            let at = d.at(pin);
            let (along, _) = d.guide_at(slide, at);
            let on_rider = d.pull_along(along, size);
            let item = Item { pull: Some(on_rider), at, couple: None };
            match d.mechanism.party_of(&pair.rider) {
                crate::mechanism::force::Party::Link(rider) => balance.known[rider.0].push(item),
                crate::mechanism::force::Party::Pin(pin) => balance.push_on_pin(d, pin, item),
            }
            let back = Item { pull: Some(Draughtsman::opposite(on_rider)), at, couple: None };
            balance.known[pair.guide.link.0].push(back);
            balance.efforts.push((Sought::Effort(input), size));
        }
        Closing::Contact { roll, .. } => {
            let [_, second] = d.mechanism.rolls[roll].bodies();
            let contact = d.contact_at(roll);
            let push = d.pull_along(contact.push, size);
            d.rolls_between(balance, roll, (second, push), contact.at);
        }
        Closing::Roll { roll } => {
            let [_, second] = d.mechanism.rolls[roll].bodies();
            let contact = d.contact_at(roll);
            let pull = d.rolling_pull(balance, (roll, second), &contact, size);
            d.rolls_between(balance, roll, (second, pull), contact.at);
        }
    }
}

impl Balance {
    /// Notes the effort of an input, or what would have to hold a trial driver.
    pub(super) fn note_effort(&mut self, input: Drive, size: Amount) {
        match input {
            Drive::Input(input) => self.efforts.push((Sought::Effort(input), size)),
            Drive::Trial(driver) => self.held.push((driver, size)),
            Drive::With(_) => self.refused = Some(KNOWN_TURNING),
        }
    }
}
