//! The route that a scene asks for where a group has two: three forces that meet in a point and their triangle, or
//! moments about the pins.

use crate::board::{Line, Point};
use crate::mechanism::LinkId;
use crate::mechanism::force::{Force, Share};
use crate::mechanism::quantity::{Method, Quantity};
use crate::mechanism::structure::{Group, GroupKind};

use super::super::draughtsman::Draughtsman;
use super::{Balance, Item, Pull, ThreeForces};

/// Two lines that cross at less than this sine are parallel: they have no meet on paper.
const PARALLEL: f64 = 1e-3;
/// A meet that is nearer to the pin than this, mm, gives the third force no line.
const TOO_NEAR: f64 = 1e-3;

const ONE_ROUTE: &str = "the group that finds this force has one route alone";
const BOTH_ROUTES: &str = "the group that finds this force is asked for by three forces and by components";
const TWO_LOADED: &str =
    "more than three forces: something acts on both links of the group that finds this force";
const NOTHING_ACTS: &str = "fewer than three forces: nothing acts on the link, or a couple alone";
const NO_MEET: &str =
    "the lines of the known force and of the second one are parallel: three forces do not meet on paper";
const IN_THE_PIN: &str = "the three forces meet in the pin itself, which gives the third one no line";

impl Draughtsman<'_> {
    /// The group that finds the force of a pair: the later one of those of its two links.
    fn finding_group(&self, [by, on]: [LinkId; 2]) -> Option<usize> {
        [by, on].into_iter().filter_map(|link| self.structure.group_of(link)).max()
    }

    /// Whether a method is asked for a force that this group finds.
    fn asks(&self, group: usize, method: Method) -> bool {
        let asked = self.mechanism.asked.iter().filter(|asked| asked.method == method);
        let mut pairs = asked.filter_map(|asked| match asked.quantity {
            Quantity::Force(force, _) => force.pair(),
            _ => None,
        });
        pairs.any(|pair| self.finding_group(pair) == Some(group))
    }

    /// Whether the components of a force are asked that the group of this link finds.
    pub(super) fn asks_components(&self, link: LinkId) -> bool {
        self.structure.group_of(link).is_some_and(|group| self.asks(group, Method::Components))
    }

    /// Notes why a group has no second route.
    pub(super) fn one_route_only(&self, group: &Group, balance: &mut Balance) {
        if let Some(index) = group.links.first().and_then(|link| self.structure.group_of(*link))
            && let Some(why) = self.no_second_route(index)
        {
            balance.no_route.insert(index, why);
        }
    }

    fn no_second_route(&self, group: usize) -> Option<&'static str> {
        let two = matches!(
            self.structure.groups[group].kind,
            GroupKind::Rrr { .. } | GroupKind::Rrp { .. } | GroupKind::Rpr { .. }
        );
        match [Method::ThreeForce, Method::Components].map(|method| self.asks(group, method)) {
            [false, false] => None,
            [true, true] => Some(BOTH_ROUTES),
            _ => (!two).then_some(ONE_ROUTE),
        }
    }

    /// The second of three forces on a link, in its line, where that is the route that is asked for: the third one passes
    /// through the pin. `items` are what is known to act on the link and on the other one of its group.
    pub(super) fn by_three_forces(
        &mut self,
        balance: &mut Balance,
        link: LinkId,
        (on_link, on_other): (&[Item], &[Item]),
        second: Line,
        pin: Point,
    ) -> Option<Pull> {
        let group = self.structure.group_of(link)?;
        if !self.asks(group, Method::ThreeForce) || balance.no_route.contains_key(&group) {
            return None;
        }
        match self.three_forces(link, (on_link, on_other), second, pin) {
            Ok((pull, meet)) => {
                balance.meets.push(meet);
                Some(pull)
            }
            Err(why) => {
                balance.no_route.insert(group, why);
                None
            }
        }
    }

    fn three_forces(
        &mut self,
        link: LinkId,
        (on_link, on_other): (&[Item], &[Item]),
        second: Line,
        pin: Point,
    ) -> Result<(Pull, ThreeForces), &'static str> {
        if !on_other.is_empty() {
            return Err(TWO_LOADED);
        }
        let sum = self.sum_of(on_link);
        if self.board.distance(sum.tail, sum.head).value() == 0.0 {
            return Err(NOTHING_ACTS);
        }
        let through = self.foot_of_line(on_link).ok_or(NOTHING_ACTS)?;
        let reason = self.reason(&[link]);
        let (along, _) = self.board.toward(sum.tail, sum.head, reason);
        let meet = self.board.meet_lines(Line { through, along }, second, reason);
        if libm::sin(meet.crossing) < PARALLEL {
            return Err(NO_MEET);
        }
        if self.board.distance(meet.at, pin).value() < TOO_NEAR {
            return Err(IN_THE_PIN);
        }
        let (third, _) = self.board.toward(meet.at, pin, reason);
        let [found, _] = self.two_lines(&[sum], [second.along, third], &[link]);
        Ok((found, ThreeForces { link, at: meet.at, through }))
    }

    /// Why the route that is asked for a force does not exist.
    pub(in super::super) fn route_refused(&self, force: Force, share: Share) -> Option<&'static str> {
        let group = self.finding_group(force.pair()?)?;
        let (_, balance) = self.balances.iter().find(|(of, _)| *of == share)?;
        balance.no_route.get(&group).copied()
    }
}
