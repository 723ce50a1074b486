//! Reads the asked forces off the balance.

use crate::board::{Amount, Line, Point};
use crate::mechanism::force::{Action, Force, Share, Sought, SpringKind, Through};
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{LinkId, PointId};

use super::super::draughtsman::Draughtsman;
use super::{Balance, Item, Pull};

/// What stands for a force on the board.
pub(in super::super) enum ForceRead {
    Vector([Amount; 2]),
    Scalar(Amount),
    /// A distance beyond all bounds.
    AtInfinity,
    Undefined(&'static str),
}

const NOT_DRAWN: &str = "no polygon of the drawing leads to this force";
pub(super) const UNBALANCED: &str =
    "what is sought does no work here, and without work of it these links are not in balance";
const NO_CARRIER: &str = "balance does not say how these links share their pin: name its `carrier` in `pins`, or ask for the force of the pin";
const NO_LINE: &str = "the force is zero and has no line";
const NO_INERTIA: &str = "neither an inertia force nor a couple acts: there is no line";

type Found<T> = Result<T, &'static str>;

/// Why a balance has no force of a pair.
fn not_found(balance: &Balance) -> &'static str {
    if balance.unbalanced { UNBALANCED } else { NOT_DRAWN }
}

impl Draughtsman<'_> {
    /// An asked force.
    pub(in super::super) fn read_force(&mut self, force: Force, share: Share) -> ForceRead {
        self.find_force(force, share).unwrap_or_else(ForceRead::Undefined)
    }

    fn balance_of(&self, share: Share) -> Found<Balance> {
        let found = self.balances.iter().find(|(of, _)| *of == share).map(|(_, balance)| balance.clone());
        let balance = found.ok_or(NOT_DRAWN)?;
        match balance.refused {
            Some(why) => Err(why),
            None => Ok(balance),
        }
    }

    fn find_force(&mut self, force: Force, share: Share) -> Found<ForceRead> {
        Ok(match force {
            Force::Vector(action) => {
                let items = self.items_of(action, share)?;
                let sum = self.sum_of(&items);
                ForceRead::Vector(self.components_of(sum))
            }
            Force::Along { by, on, from } | Force::Across { by, on, from } => {
                let items = self.items_of(Action::Pair { by, on }, share)?;
                let sum = self.sum_of(&items);
                let pin = self.mechanism.meeting_point(by, on).ok_or(NOT_DRAWN)?;
                let (a, b) = (self.at(from), self.at(pin));
                let reason = self.reason(&[by, on]);
                let (along, _) = self.board.toward(a, b, reason);
                // The foot of the force's head on the line through its tail.
                let [size, _] = self.board.square_off(Line { through: sum.tail, along }, sum.head);
                let foot = self.board.step_off(sum.tail, along, size);
                let part = if matches!(force, Force::Along { .. }) {
                    Pull { tail: sum.tail, head: foot }
                } else {
                    Pull { tail: foot, head: sum.head }
                };
                ForceRead::Vector(self.components_of(part))
            }
            Force::Torque(input) | Force::Drive(input) => {
                ForceRead::Scalar(self.effort_of(Sought::Effort(input), share)?)
            }
            Force::LoadTorque(index) => match self.mechanism.forces.loads[index].is_sought() {
                true => ForceRead::Scalar(self.effort_of(Sought::Load(index), share)?),
                false => {
                    let load = self.mechanism.forces.loads[index].clone();
                    let item = self.load(&load, None);
                    ForceRead::Scalar(item.couple.ok_or(NOT_DRAWN)?)
                }
            },
            Force::Pull(index) => {
                let spring = self.mechanism.forces.springs[index].clone();
                let SpringKind::Pull(ends) = spring.kind else { return Err(NOT_DRAWN) };
                let assumed = match spring.is_sought() {
                    true => Some(self.effort_of(Sought::Spring(index), share)?),
                    false => None,
                };
                ForceRead::Scalar(self.spring_pull(spring.law, ends.map(|(_, p)| p), assumed))
            }
            Force::Spin => {
                let square = self.effort_of(Sought::Spin, share)?;
                if square.value() < 0.0 {
                    return Err(super::NO_SPEED);
                }
                ForceRead::Scalar(self.board.root(square))
            }
            Force::Twist(index) => {
                let spring = self.mechanism.forces.springs[index].clone();
                let SpringKind::Torsion(links) = spring.kind else { return Err(NOT_DRAWN) };
                let assumed = match spring.is_sought() {
                    true => Some(self.effort_of(Sought::Spring(index), share)?),
                    false => None,
                };
                ForceRead::Scalar(self.spring_torque(spring.law, links, assumed))
            }
            Force::InertiaTorque(link) => {
                let mass = *self.mechanism.forces.mass(link).ok_or(NOT_DRAWN)?;
                let torque = if share == Share::Static { None } else { self.inertia_torque(&mass) };
                let rest = self.rest();
                ForceRead::Scalar(torque.unwrap_or(rest))
            }
            Force::Offset(link) => {
                let mass = *self.mechanism.forces.mass(link).ok_or(NOT_DRAWN)?;
                let items = self.inertia_items(&mass, share);
                let sum = self.sum_of(&items);
                let mm = self.board.distance(sum.tail, sum.head);
                if !self.board.is_nothing(mm) {
                    return self.find_force(Force::Arm(Action::Inertia(link), mass.centre), share);
                }
                let couple = items.iter().find_map(|item| item.couple);
                match couple {
                    Some(couple) if !self.board.is_no_amount(couple) => ForceRead::AtInfinity,
                    _ => return Err(NO_INERTIA),
                }
            }
            Force::Moment(action, about) => {
                let items = self.items_of(action, share)?;
                let about = self.at(about);
                let rest = self.rest();
                ForceRead::Scalar(self.moments(&items, about).unwrap_or(rest))
            }
            Force::Arm(action, about) => {
                let items = self.items_of(action, share)?;
                let about = self.at(about);
                let sum = self.sum_of(&items);
                let rest = self.rest();
                let moment = self.moments(&items, about).unwrap_or(rest);
                let mm = self.board.distance(sum.tail, sum.head);
                let scale = self.force_scale();
                if mm.value() == 0.0 || self.board.is_nothing(mm) {
                    return Err(NO_LINE);
                }
                let size = self.board.read(mm, scale);
                let reason = self.reason(&[]);
                let arm = self.board.quotient(moment, size, reason);
                ForceRead::Scalar(self.board.magnitude(arm))
            }
        })
    }

    fn effort_of(&mut self, sought: Sought, share: Share) -> Found<Amount> {
        let found = self.balances.iter().find(|(of, _)| *of == share).map(|(_, balance)| balance);
        let balance = found.ok_or(NOT_DRAWN)?;
        match balance.refused {
            // What does no work says so itself.
            None | Some(UNBALANCED) => {
                let mut efforts = balance.efforts.iter();
                efforts.find(|(of, _)| *of == sought).map(|(_, size)| *size).ok_or(NOT_DRAWN)
            }
            Some(why) => Err(why),
        }
    }

    pub(super) fn sum_of(&mut self, items: &[Item]) -> Pull {
        match super::pulls(items)[..] {
            [only] => only,
            ref several => {
                let head = self.chained(several);
                Pull { tail: self.board.origin(), head }
            }
        }
    }

    /// The forces of which an action is the sum, each at its place.
    pub(in super::super) fn items_of(&mut self, action: Action, share: Share) -> Found<Vec<Item>> {
        match action {
            Action::Inertia(link) => {
                let mass = *self.mechanism.forces.mass(link).ok_or(NOT_DRAWN)?;
                Ok(self.inertia_items(&mass, share))
            }
            Action::Centrifugal(link) => {
                let mass = *self.mechanism.forces.mass(link).ok_or(NOT_DRAWN)?;
                let spin = self.mechanism.forces.spin.ok_or(NOT_DRAWN)?;
                let assumed = match spin.omega {
                    SpinSpeed::Sought => Some(self.effort_of(Sought::Spin, share)?),
                    SpinSpeed::Given(_) => None,
                };
                Ok(self.centrifugal(&spin, &mass, assumed).into_iter().collect())
            }
            Action::Shaking => {
                let masses = self.mechanism.forces.masses.clone();
                Ok(masses.iter().flat_map(|mass| self.inertia_items(mass, share)).collect())
            }
            Action::Load(index) => {
                let load = self.mechanism.forces.loads[index].clone();
                let assumed = match load.is_sought() {
                    true => Some(self.effort_of(Sought::Load(index), share)?),
                    false if share == Share::Inertia => return Ok(Vec::new()),
                    false => None,
                };
                Ok(vec![self.load(&load, assumed)])
            }
            Action::Weight(link) => {
                let mass = *self.mechanism.forces.mass(link).ok_or(NOT_DRAWN)?;
                let at = self.at(mass.centre);
                let pull = self.weight(&mass).ok_or(NOT_DRAWN)?;
                Ok(vec![Item { pull: Some(pull), at, couple: None }])
            }
            Action::Spring { index, end } => {
                let spring = self.mechanism.forces.springs[index].clone();
                let SpringKind::Pull(ends) = spring.kind else { return Err(NOT_DRAWN) };
                let assumed = match spring.is_sought() {
                    true => Some(self.effort_of(Sought::Spring(index), share)?),
                    false => None,
                };
                let pull = self.spring_pull(spring.law, ends.map(|(_, p)| p), assumed);
                let (own, other) = (self.at(ends[end].1), self.at(ends[1 - end].1));
                let reason = self.reason(&ends.map(|(link, _)| link));
                let (toward, _) = self.board.toward(own, other, reason);
                Ok(vec![Item { pull: Some(self.pull_along(toward, pull)), at: own, couple: None }])
            }
            Action::Drive(input) => {
                let size = self.effort_of(Sought::Effort(input), share)?;
                let Some(crate::mechanism::Input::Slide { slide, .. }) = self.mechanism.inputs.get(input)
                else {
                    return Err(NOT_DRAWN);
                };
                let slide = *slide;
                let at = self.mechanism.pin_of_slide(slide).ok_or(NOT_DRAWN)?;
                let at = self.at(at);
                let (along, _) = self.guide_at(slide, at);
                Ok(vec![Item { pull: Some(self.pull_along(along, size)), at, couple: None }])
            }
            Action::DriveBack(input) => {
                let items = self.items_of(Action::Drive(input), share)?;
                Ok(items.into_iter().map(|item| self.reversed(item)).collect())
            }
            Action::Drag(_) => {
                let spin = self.mechanism.forces.spin.ok_or(NOT_DRAWN)?;
                let drag = spin.drag.ok_or(NOT_DRAWN)?;
                Ok(vec![self.drag_on_sleeve(&spin, drag, share)?])
            }
            Action::Pair { by, on } => {
                let balance = self.balance_of(share)?;
                let mut items = Vec::new();
                for pair in self.mechanism.pairs_between(by, on) {
                    items.extend(self.through(&balance, pair, by, on)?);
                }
                Ok(items)
            }
            Action::OfPin(pin, link) => {
                let balance = self.balance_of(share)?;
                Ok(vec![self.of_pin(&balance, pin, link)?])
            }
            Action::OnPin(link, pin) => {
                let balance = self.balance_of(share)?;
                let item = self.of_pin(&balance, pin, link)?;
                Ok(vec![self.reversed(item)])
            }
            Action::Rolling { roll, on } => {
                let balance = self.balance_of(share)?;
                let [by, on] = self.mechanism.bodies_rolling(roll, on);
                self.through(&balance, Through::Roll(roll), by, on)
            }
            Action::OnFrame => {
                let balance = self.balance_of(share)?;
                self.on_frame(&balance)
            }
        }
    }

    fn inertia_items(&mut self, mass: &crate::mechanism::force::Mass, share: Share) -> Vec<Item> {
        if share == Share::Static {
            return Vec::new();
        }
        let at = self.at(mass.centre);
        let (pull, couple) = (self.inertia_force(mass), self.inertia_couple(mass));
        if pull.is_none() && couple.is_none() { Vec::new() } else { vec![Item { pull, at, couple }] }
    }

    fn reversed(&mut self, item: Item) -> Item {
        Item {
            pull: item.pull.map(Self::opposite),
            at: item.at,
            couple: item.couple.map(|couple| self.board.opposite(couple)),
        }
    }

    /// What one link exerts on another through a pair: its force, and beside it what drags in a guide, each where it acts.
    fn through(&mut self, balance: &Balance, pair: Through, by: LinkId, on: LinkId) -> Found<Vec<Item>> {
        match pair {
            Through::Pin(pin) => {
                if self.mechanism.parties_at(pin).len() > 2 {
                    let carrier = self.mechanism.carrier(pin);
                    if carrier == Some(by) {
                        return Ok(vec![self.of_pin(balance, pin, on)?]);
                    }
                    if carrier != Some(on) {
                        return Err(NO_CARRIER);
                    }
                    let item = self.of_pin(balance, pin, by)?;
                    return Ok(vec![self.reversed(item)]);
                }
                if let Some((_, guide)) = self.mechanism.drive_between(pin, [by, on]) {
                    let item = self.of_pin(balance, pin, guide)?;
                    return Ok(vec![if on == guide { item } else { self.reversed(item) }]);
                }
                Ok(vec![self.of_pin(balance, pin, on)?])
            }
            Through::Slide(index) => {
                let items = self.on_rider(balance, index)?;
                let by_rider = on == self.mechanism.slides[index].guide.link;
                Ok(if by_rider { items.into_iter().map(|item| self.reversed(item)).collect() } else { items })
            }
            Through::Roll(roll) => {
                let item = balance.rolls.get(&roll).ok_or(not_found(balance))?.item();
                let [_, second] = self.mechanism.rolls[roll].bodies();
                Ok(vec![if on == second { item } else { self.reversed(item) }])
            }
        }
    }

    /// The force of a guide on what rides, and what drags beside it.
    fn on_rider(&mut self, balance: &Balance, slide: usize) -> Found<Vec<Item>> {
        let force = balance.slides.get(&slide).ok_or(not_found(balance))?.item();
        let mut items = vec![force];
        if let (Some(drag), Some(point)) = (balance.leaning.drag(slide), self.mechanism.pin_of_slide(slide)) {
            items.push(Item { pull: Some(drag), at: self.at(point), couple: None });
        }
        Ok(items)
    }

    /// The force of a pin on a link: as it was found, or what all others at the pin leave.
    fn of_pin(&mut self, balance: &Balance, pin: PointId, link: LinkId) -> Found<Item> {
        let at = self.touch_at(balance, pin, link);
        if let Some(pull) = balance.of_pins.get(&(pin.0, link.0)) {
            return Ok(Item { pull: Some(*pull), at, couple: None });
        }
        let parties = self.mechanism.parties_at(pin);
        let mut others = Vec::new();
        let mut items = Vec::new();
        for other in parties.into_iter().filter(|other| *other != link) {
            let pull = *balance.of_pins.get(&(pin.0, other.0)).ok_or(not_found(balance))?;
            others.push(pull);
            if Self::rubs_at(balance, pin) {
                let touch = self.touch_at(balance, pin, other);
                items.push(Item { pull: Some(Self::opposite(pull)), at: touch, couple: None });
            }
        }
        // What drives the pin goes on to whoever holds it.
        if let Some((input, guide)) = self.mechanism.drive_of_pin(pin)
            && guide != link
        {
            let drive = self.items_of(Action::Drive(input), balance.share)?;
            others.extend(drive.into_iter().filter_map(|item| item.pull).map(Self::opposite));
        }
        let pull = match others[..] {
            [only] => Self::opposite(only),
            _ => self.closing(&others),
        };
        // Several that touch their circles leave a couple besides.
        let couple = if items.len() > 1 { self.moments(&items, at) } else { None };
        Ok(Item { pull: Some(pull), at, couple })
    }

    /// What moving links exert on the frame, pair by pair.
    fn on_frame(&mut self, balance: &Balance) -> Found<Vec<Item>> {
        let mut items = Vec::new();
        let frame = LinkId::FRAME;
        for pin in (0..self.mechanism.points.len()).map(PointId) {
            let parties = self.mechanism.parties_at(pin);
            if parties.len() > 1 && parties.contains(&frame) {
                items.push(self.of_pin(balance, pin, frame)?);
            }
        }
        for (index, slide) in self.mechanism.slides.clone().into_iter().enumerate() {
            let block =
                matches!(self.mechanism.party_of(&slide.rider), crate::mechanism::force::Party::Link(_));
            if block && slide.guide.link == frame {
                for item in self.on_rider(balance, index)? {
                    items.push(self.reversed(item));
                }
            } else if self.mechanism.party_of(&slide.rider) == crate::mechanism::force::Party::Link(frame) {
                items.extend(self.on_rider(balance, index)?);
            }
        }
        for (roll, pair) in self.mechanism.rolls.clone().into_iter().enumerate() {
            let [first, second] = pair.bodies();
            if [first, second].contains(&frame) {
                let by = if first == frame { second } else { first };
                items.extend(self.through(balance, Through::Roll(roll), by, frame)?);
            }
        }
        Ok(items)
    }

    /// A point of the line of an action, metres in the world: where it acts, shifted by its couple; and what it turns about
    /// the place where it acts first, N·m.
    pub(in super::super) fn line_and_couple(
        &mut self,
        action: Action,
        share: Share,
    ) -> (Option<[f64; 2]>, Option<f64>) {
        let Ok(items) = self.items_of(action, share) else { return (None, None) };
        let Some(first) = items.first().map(|item| item.at) else { return (None, None) };
        let couple = self.moments(&items, first).map(|moment| moment.value());
        let through = self.foot_of_line(&items).map(|foot| self.in_the_world(foot));
        (through, couple)
    }

    /// A place of the skeleton, metres in the world.
    pub(in super::super) fn in_the_world(&self, place: Point) -> [f64; 2] {
        let per_mm = self.length_scale().si_per_mm;
        let origin = self.origin_of_space().map(|given| given.value);
        let [x, y] = place.value().map(|mm| mm * per_mm);
        [origin[0] + x, origin[1] + y]
    }

    /// The point of the line of a resultant that is nearest to where its first force acts: laid off square to the
    /// resultant, as far as their moment about that place divided by it. That place itself of one force alone, and of
    /// what has no size.
    pub(in super::super) fn foot_of_line(&mut self, items: &[Item]) -> Option<Point> {
        let first = items.first()?;
        if items.len() == 1 && first.couple.is_none() {
            return Some(first.at);
        }
        let sum = self.sum_of(items);
        let mm = self.board.distance(sum.tail, sum.head);
        let moment = self.moments(items, first.at).filter(|_| mm.value() != 0.0);
        let Some(moment) = moment else { return Some(first.at) };
        let (forces, lengths) = (self.force_scale(), self.length_scale());
        let size = self.board.read(mm, forces);
        let reason = self.reason(&[]);
        let arm = self.board.quotient(moment, size, reason);
        let arm = self.board.to_paper(arm, lengths);
        let (along, _) = self.board.toward(sum.tail, sum.head, reason);
        let left = self.board.quarter_turn(along);
        let right = self.board.reverse(left);
        // A force to the right of a point turns ccw about it.
        Some(self.board.step_off(first.at, right, arm))
    }
}
