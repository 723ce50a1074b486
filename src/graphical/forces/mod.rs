//! Forces: loads, weights and inertia laid off, and the balance of group after group, from the output back to the input.
//!
//! Each unknown is found as a textbook finds it: moments about a point through which all other unknowns pass give one
//! size, as a quotient of moments by a measured arm; a polygon with two lines gives two. What is left closes a
//! polygon. A force is a stroke of the force paper from its tail to its head; its place is a point of the skeleton.

mod departing;
mod driven;
mod friction;
mod governor;
mod groups;
mod higher;
mod loads;
mod moments;
mod order;
mod read;
mod record;
mod rolling;
mod routes;
mod sought;
mod spin;
mod triad;

pub(crate) use friction::holds;
pub(super) use friction::{Begun, redrawn};
pub(super) use read::ForceRead;
pub(super) use record::{quantities, record, record_numbers};
pub(super) use rolling::PULLS;
pub(super) use spin::NO_SPEED;

use std::collections::{BTreeMap, BTreeSet};

use crate::board::{Amount, Direction, Line, Point, Scale};
use crate::mechanism::force::{Action, Party, Share, Sought};
use crate::mechanism::structure::{GroupKind, TrialDriver};
use crate::mechanism::{LinkId, PointId};
use crate::plan::Plan;

use super::construction::{GroupTrial, Trial, Trials};
use super::draughtsman::Draughtsman;
use friction::Leaning;
use rolling::RollForce;

/// A force as drawn.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pull {
    pub(super) tail: Point,
    pub(super) head: Point,
}

/// Something known that acts on a body.
#[derive(Debug, Clone, Copy)]
pub(super) struct Item {
    /// The force; none of a couple alone.
    pub(super) pull: Option<Pull>,
    /// A point of its line, on the skeleton.
    pub(super) at: Point,
    /// A couple beside it, ccw positive.
    pub(super) couple: Option<Amount>,
}

/// The force of a guide on what rides, through its pin or first joint.
#[derive(Debug, Clone, Copy)]
pub(super) struct SlideForce {
    pub(super) pull: Pull,
    pub(super) at: Point,
    pub(super) couple: Option<Amount>,
}

impl SlideForce {
    fn item(self) -> Item {
        Item { pull: Some(self.pull), at: self.at, couple: self.couple }
    }
}

/// The balance of one share of what acts, as far as it is drawn.
#[derive(Debug, Clone, Default)]
pub(super) struct Balance {
    /// What is known to act on each link, by link; the frame first.
    known: Vec<Vec<Item>>,
    /// What is known to act on a pin that no solved link holds.
    on_free_pins: BTreeMap<usize, Vec<Item>>,
    /// The force of a pin on a link that does not hold it.
    pub(super) of_pins: BTreeMap<(usize, usize), Pull>,
    /// By index of the sliding pair.
    pub(super) slides: BTreeMap<usize, SlideForce>,
    /// By index of the rolling pair, on the second of its bodies.
    rolls: BTreeMap<usize, RollForce>,
    /// The links that are in balance already.
    balanced: BTreeSet<LinkId>,
    /// Of what acts.
    share: Share,
    /// How groups of higher class were balanced.
    group_trials: Vec<GroupTrial>,
    /// What would have to hold the drivers of a trial.
    held: Vec<(TrialDriver, Amount)>,
    /// What was sought.
    pub(super) efforts: Vec<(Sought, Amount)>,
    /// Sizes that are tried for what is sought elsewhere than at the input.
    assumed: Vec<(Sought, Amount)>,
    /// How what was sought elsewhere than at the input was found.
    pub(super) trial: Option<Trial>,
    /// The same of several.
    pub(super) trials: Option<Trials>,
    /// Where three forces on a link meet.
    pub(super) meets: Vec<ThreeForces>,
    /// Why the route that was asked for a group does not exist, by its index.
    no_route: BTreeMap<usize, &'static str>,
    /// Links whose polygon is one, as if they were one body; each of them but the first is balanced on its own after it.
    pub(super) as_one: Vec<Vec<LinkId>>,
    /// Links that have two forces together, and the points at which these act.
    pub(super) members: Vec<(Vec<LinkId>, [PointId; 2])>,
    /// Pins that are driven along a guide which does not pass its lever's base, with the lever: moments give what they pass
    /// on in all.
    pub(super) whole_pins: Vec<(PointId, LinkId)>,
    /// Moments that gave a size, in the order in which they were taken.
    pub(super) taken: Vec<Taken>,
    /// What could not be drawn, and why.
    pub(super) refused: Option<&'static str>,
    /// The links that were not come to are out of balance, since what is sought does no work.
    pub(super) unbalanced: bool,
    /// Where forces touch friction circles, and how they lean.
    leaning: Leaning,
}

/// Three forces on a link, of which one is known, meet in a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct ThreeForces {
    pub(super) link: LinkId,
    /// On the skeleton.
    pub(super) at: Point,
    /// A point of the line of the known one.
    pub(super) through: Point,
}

/// Moments of bodies about a point through which all unknowns pass but one.
#[derive(Debug, Clone)]
pub(super) struct Taken {
    /// The bodies, as if they were one.
    pub(super) links: Vec<LinkId>,
    pub(super) about: About,
    pub(super) found: TakenFor,
}

/// About what moments are taken.
#[derive(Debug, Clone)]
pub(super) enum About {
    Point(PointId),
    /// Where the lines of two forces meet; of the bars that are legs of the link the pin, the bar, its pin on a solved
    /// link, and whether something acts on it besides.
    Meet {
        of: [Action; 2],
        at: Point,
        bars: Vec<(PointId, LinkId, PointId, bool)>,
    },
}

/// What the moments gave.
#[derive(Debug, Clone, Copy)]
pub(super) enum TakenFor {
    /// The torque at an input.
    Effort(usize),
    /// The force at a driven slide, by index of the input.
    Driven(usize),
    /// Of the force of one link on another at a pin the part across the line from a point.
    Across { pin: PointId, by: LinkId, on: LinkId, from: PointId },
    /// The part along it, which may be the whole.
    Along { pin: PointId, by: LinkId, on: LinkId, from: PointId, whole: bool },
    /// The force of a guide on what rides, by index of the sliding pair.
    Slide(usize),
    /// The same where what rides acts on the guide of a lever.
    Slot(usize),
    /// Of the force of an arc on its block the part across the line from the pin to the arc's centre.
    Arc(usize),
    /// The force of a rolling pair on one of its bodies; of a pair that keeps its contact what presses, or what is along
    /// the tangent.
    Roll { roll: usize, on: LinkId, presses: bool },
}

/// Who holds a pin: the link on which every force on the pin is laid off.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Holder {
    Link(LinkId),
    /// The pin itself, before any link that has it is solved.
    Pin,
}

impl Draughtsman<'_> {
    /// The scale of the force paper.
    pub(super) fn force_scale(&self) -> Scale {
        Scale { si_per_mm: self.per_newton }
    }

    /// A force of no size.
    pub(super) fn no_pull(&mut self) -> Pull {
        let pole = self.board.origin();
        Pull { tail: pole, head: pole }
    }

    /// A force of this size along a direction.
    pub(super) fn pull_along(&mut self, along: Direction, size: Amount) -> Pull {
        let tail = self.board.origin();
        let scale = self.force_scale();
        let mm = self.board.to_paper(size, scale);
        Pull { tail, head: self.board.lay_off(tail, along, mm) }
    }

    /// The opposite force.
    pub(super) fn opposite(pull: Pull) -> Pull {
        Pull { tail: pull.head, head: pull.tail }
    }

    /// Forces laid off head to tail from the pole: where the last one ends.
    pub(super) fn chained(&mut self, pulls: &[Pull]) -> Point {
        let mut head = self.board.origin();
        for pull in pulls {
            let by = self.board.between(pull.tail, pull.head);
            head = self.board.moved(head, by);
        }
        head
    }

    /// The force that closes the polygon of others.
    pub(super) fn closing(&mut self, pulls: &[Pull]) -> Pull {
        let tail = self.chained(pulls);
        Pull { tail, head: self.board.origin() }
    }

    /// The components of a force, read off.
    pub(super) fn components_of(&mut self, pull: Pull) -> [Amount; 2] {
        let scale = self.force_scale();
        let [x, y] = self.board.between(pull.tail, pull.head);
        [self.board.read(x, scale), self.board.read(y, scale)]
    }

    /// The moment of a force about a point: of its two components, each by its arm.
    pub(super) fn moment_of(&mut self, pull: Pull, at: Point, about: Point) -> Amount {
        let scale = self.length_scale();
        let [x, y] = self.board.between(about, at);
        let (x, y) = (self.board.read(x, scale), self.board.read(y, scale));
        let [fx, fy] = self.components_of(pull);
        let (ccw, cw) = (self.board.product(x, fy), self.board.product(y, fx));
        self.board.difference(ccw, cw)
    }

    /// The sum of moments of what acts about a point; `None` where nothing acts.
    pub(super) fn moments(&mut self, items: &[Item], about: Point) -> Option<Amount> {
        let mut sum: Option<Amount> = None;
        for item in items {
            let of_force = item.pull.map(|pull| self.moment_of(pull, item.at, about));
            for part in [of_force, item.couple].into_iter().flatten() {
                sum = Some(match sum {
                    Some(sum) => self.board.sum(sum, part),
                    None => part,
                });
            }
        }
        sum
    }

    /// The arm of a line from a point, positive where a force along the line turns ccw about the point.
    pub(super) fn arm_of(&mut self, line: Line, about: Point) -> Amount {
        let scale = self.length_scale();
        let [_, across] = self.board.square_off(line, about);
        self.board.read(across, scale)
    }

    /// The sum of two moments that may be absent.
    pub(super) fn both(&mut self, a: Option<Amount>, b: Option<Amount>) -> Option<Amount> {
        match (a, b) {
            (Some(a), Some(b)) => Some(self.board.sum(a, b)),
            (one, other) => one.or(other),
        }
    }

    /// The size of a force along a line that balances moments about a point: −ΣM / arm.
    pub(super) fn balancing(
        &mut self,
        moments: Option<Amount>,
        line: Line,
        about: Point,
        links: &[LinkId],
    ) -> Amount {
        let Some(moments) = moments else {
            // Nothing acts: there is nothing to balance.
            return self.rest();
        };
        let arm = self.arm_of(line, about);
        let reason = self.reason(links);
        let size = self.board.quotient(moments, arm, reason);
        self.board.opposite(size)
    }

    /// Who holds a pin.
    pub(super) fn holder(&self, pin: PointId) -> Holder {
        let m = self.mechanism;
        if m.is_fixed(pin) {
            return Holder::Link(LinkId::FRAME);
        }
        if let Some(carrier) = self.holds_by_friction(pin) {
            return Holder::Link(carrier);
        }
        let links = m.point(pin).links.iter().copied();
        let first = links.filter_map(|l| self.order_of(l).map(|g| (g, l))).min();
        let found = self.order_of_point(pin);
        match (first, found) {
            (Some((group, _)), Some(found)) if found < group => Holder::Pin,
            (Some((_, link)), _) => Holder::Link(link),
            (None, _) => Holder::Pin,
        }
    }
}

impl Draughtsman<'_> {
    /// The place of a link in the order of transmission: of its group, and within a group of higher class among those into
    /// which its trial falls; what the trial leaves open comes last.
    fn order_of(&self, link: LinkId) -> Option<(usize, usize)> {
        let group = self.structure.group_of(link)?;
        let GroupKind::Higher { trial } = self.structure.groups[group].kind else { return Some((group, 0)) };
        let within = self.trial(trial).groups.iter().position(|inner| inner.links.contains(&link));
        Some((group, within.unwrap_or(usize::MAX)))
    }

    /// The place in that order at which a joint is found; none of what is found with the figure of a link.
    fn order_of_point(&self, pin: PointId) -> Option<(usize, usize)> {
        let group = self.structure.groups.iter().position(|group| group.points.contains(&pin))?;
        let GroupKind::Higher { trial } = self.structure.groups[group].kind else { return Some((group, 0)) };
        let within = self.trial(trial).groups.iter().position(|inner| inner.points.contains(&pin))?;
        Some((group, within))
    }

    /// The carrier of a pin that rubs, where it is found with the group that comes to the pin first.
    fn holds_by_friction(&self, pin: PointId) -> Option<LinkId> {
        let m = self.mechanism;
        m.forces.friction.circle(pin)?;
        let carrier = m.rubbing_carrier(pin)?;
        let of = self.order_of(carrier)?;
        let orders = m.point(pin).links.iter().filter_map(|link| self.order_of(*link));
        let found = self.order_of_point(pin);
        (orders.min() == Some(of) && found.is_none_or(|found| found >= of)).then_some(carrier)
    }
}

/// What was found by two trials and proportion, where it is something.
pub(super) fn found_by_trial(d: &Draughtsman<'_>) -> Vec<(Share, f64)> {
    let found = d.balances.iter().filter_map(|(share, balance)| Some((*share, balance.trial?.size)));
    found.filter(|(_, size)| *size != 0.0 && size.is_finite()).collect()
}

/// Draws the balance of what the plan needs.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) {
    for &share in &plan.forces.shares {
        let balance = if friction::rubs(d) {
            friction::balance(d, plan, share)
        } else {
            whole(d, plan, share, &Leaning::default())
        };
        let mut balance = balance;
        d.judge_contacts(&mut balance);
        d.balances.push((share, balance));
    }
}

/// The balance of one share, with forces that lean so.
fn whole(d: &mut Draughtsman<'_>, plan: &Plan, share: Share, leaning: &Leaning) -> Balance {
    match d.mechanism.named_sought()[..] {
        [] => one(d, plan, (share, leaning), Vec::new()),
        ref named => sought::found(d, plan, (share, leaning), named),
    }
}

/// One pass through the groups, with these sizes for what is sought elsewhere than at an input.
fn one(
    d: &mut Draughtsman<'_>,
    plan: &Plan,
    (share, leaning): (Share, &Leaning),
    assumed: Vec<(Sought, Amount)>,
) -> Balance {
    until(d, plan, (share, leaning), assumed, &[])
}

/// The same as far as the group that holds one of these links: this one and those that it leans on are left out.
fn until(
    d: &mut Draughtsman<'_>,
    plan: &Plan,
    (share, leaning): (Share, &Leaning),
    assumed: Vec<(Sought, Amount)>,
    unbalanced: &[LinkId],
) -> Balance {
    let mut balance = Balance {
        known: vec![Vec::new(); d.mechanism.links.len()],
        assumed,
        leaning: leaning.clone(),
        share,
        ..Balance::default()
    };
    loads::lay_off(d, plan, d.share_as_laid_off(share), &mut balance);
    d.lay_off_beside(&mut balance);
    if balance.refused.is_some() {
        return balance;
    }
    d.lay_off_drags(&mut balance);
    for &group in plan.forces.groups.iter().rev() {
        let group = d.structure.groups[group].clone();
        if group.links.iter().any(|link| unbalanced.contains(link)) {
            balance.unbalanced = true;
            break;
        }
        groups::into_balance(d, &group, &mut balance);
        if balance.refused.is_some() {
            break;
        }
    }
    balance
}

impl Balance {
    /// What acts on whoever holds a pin.
    fn push_on_pin(&mut self, d: &Draughtsman<'_>, pin: PointId, item: Item) {
        match d.holder(pin) {
            Holder::Link(link) => self.known[link.0].push(item),
            Holder::Pin => self.on_free_pins.entry(pin.0).or_default().push(item),
        }
    }

    fn push_on(&mut self, party: Party, item: Item) {
        match party {
            Party::Link(link) => self.known[link.0].push(item),
            Party::Pin(pin) => self.on_free_pins.entry(pin.0).or_default().push(item),
        }
    }

    fn on(&self, link: LinkId) -> Vec<Item> {
        self.known[link.0].clone()
    }

    /// What acts on a link, if there is one.
    fn on_some(&self, link: Option<LinkId>) -> Vec<Item> {
        link.into_iter().flat_map(|link| self.on(link)).collect()
    }

    fn on_pin(&self, pin: PointId) -> Vec<Item> {
        self.on_free_pins.get(&pin.0).into_iter().flatten().copied().collect()
    }
}

/// The forces among what acts.
fn pulls(items: &[Item]) -> Vec<Pull> {
    items.iter().filter_map(|item| item.pull).collect()
}
