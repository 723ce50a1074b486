//! The balance of each kind of group.

use crate::board::{Amount, Direction, Line, Point};
use crate::mechanism::force::Party;
use crate::mechanism::structure::{Drive, Group, GroupKind, Hold, Joint, Ram};
use crate::mechanism::{LinkId, PointId};

use super::super::draughtsman::Draughtsman;
use super::super::pose::Track;
use super::moments::NO_ARM;
use super::{About, Balance, Item, Pull, SlideForce, Taken, TakenFor, driven, higher, pulls, rolling, triad};

/// Nobody has written how.
pub(super) const NO_BALANCE: &str = "this version has no balance of forces for this group";

/// Finds the forces of a group in its pairs, and gives them to the bodies on which it hangs.
pub(super) fn into_balance(d: &mut Draughtsman<'_>, group: &Group, balance: &mut Balance) {
    if let Some(why) = d.curved_block(group, balance) {
        balance.refused = Some(why);
        return;
    }
    let before = d.board.purpose("balance of a group");
    d.one_route_only(group, balance);
    match group.kind {
        GroupKind::Driver { base, input } => driver(d, group, base, input, balance),
        GroupKind::DrivenSlide { slide, input } => driven_slide(d, slide, input, balance),
        GroupKind::Rrr { links, bases, pin } => {
            rrr(d, [0, 1].map(|i| Leg::of_link(links[i], bases[i])), pin, balance);
        }
        GroupKind::Rrp { rod, base, pin, slide, rider } => {
            rrp(d, Leg::of_link(rod, base), pin, (slide, rider), balance);
        }
        GroupKind::Driven { pin, holds, riders } => driven_pin(d, pin, holds, riders, balance),
        GroupKind::Rpr { lever, base, pin, slide, rod } => rpr(d, (lever, base), pin, (slide, rod), balance),
        GroupKind::Prp { pin, slides, riders } => prp(d, pin, slides, riders, balance),
        GroupKind::Rpp { link, point, lever, base, ride, slot } => {
            rpp(d, (link, point), (lever, base), [ride, slot], balance);
        }
        GroupKind::Yoke { link, ride, pin, slot } => yoke(d, link, ride, (pin, slot), balance),
        GroupKind::DrivenBar { link, pins, holds, under, input, .. } => {
            driven::driven_bar(d, &driven::Bar { link, pins, holds, under }, input, balance);
        }
        GroupKind::Wheel { wheel, centre, roll } => rolling::wheel(d, (wheel, centre), roll, balance),
        GroupKind::Planet { .. } => {
            if !triad::on_legs(d, group, balance) {
                balance.refused = Some(NO_BALANCE);
            }
        }
        GroupKind::Rack { link, ride, roll } => rolling::rack(d, (link, ride), roll, balance),
        GroupKind::DrivenWheel { wheel, centre, roll, guide, input } => {
            rolling::driven_wheel(d, (wheel, centre), (roll, guide), input, balance);
        }
        GroupKind::DrivenRack { link, centre, roll, input, .. } => {
            rolling::driven_wheel(d, (link, centre), (roll, None), input, balance);
        }
        GroupKind::Rolling { rod: link, base, wheel, roll, .. }
        | GroupKind::PinnedRack { link, base, wheel, roll, .. } => {
            rolling::leaning(d, (link, base), wheel, roll, balance);
        }
        GroupKind::RidingCentre { link, ride, wheel, centre, roll } => {
            rolling::riding_centre(d, (link, ride), (wheel, centre), roll, balance);
        }
        GroupKind::Higher { trial } => higher::higher(d, group, trial, balance),
        GroupKind::HeldCentre { .. } | GroupKind::Other => balance.refused = Some(NO_BALANCE),
    }
    balance.balanced.extend(group.links.iter().copied());
    d.board.purpose(before);
}

/// What slides in a pair of a group, if it is a link of its own, and the party on the other side.
pub(super) struct Sliding {
    /// The block, or the link that slides without turning; none where the pin itself rides.
    pub(super) inner: Option<LinkId>,
    /// Who is on the other side.
    outer: Party,
    /// The inner side is what the pair calls its rider.
    inner_rides: bool,
}

impl Draughtsman<'_> {
    /// Why a block that something turns on its arc is not balanced: where the arc rubs besides, its force leans from the
    /// normal of another place than the pin's, and groups of higher class lay off no part of it beforehand.
    fn curved_block(&mut self, group: &Group, balance: &mut Balance) -> Option<&'static str> {
        for joint in &group.joints {
            let Joint::Slide(slide) = *joint else { continue };
            let (Some(block), Some(pin)) =
                (self.turned_on_arc(balance, slide), self.mechanism.pin_of_slide(slide))
            else {
                continue;
            };
            if balance.leaning.leans(slide) {
                return Some(
                    "this version does not draw friction on an arc along which something turns the block",
                );
            }
            let laid_off = matches!(
                group.kind,
                GroupKind::Rrp { .. }
                    | GroupKind::Driven { .. }
                    | GroupKind::Prp { .. }
                    | GroupKind::Rpr { .. }
                    | GroupKind::Yoke { .. }
            );
            if !laid_off {
                return Some("this version does not draw a couple on a block on an arc in this group");
            }
            let found = TakenFor::Arc(slide);
            balance.taken.push(Taken { links: vec![block], about: About::Point(pin), found });
        }
        None
    }

    /// The block of a sliding pair that its arc has to keep from turning about its pin: something else than forces through
    /// that pin acts on it.
    pub(super) fn turned_on_arc(&mut self, balance: &Balance, slide: usize) -> Option<LinkId> {
        let crate::mechanism::Rider::Pin { point, block: Some(block) } = self.mechanism.slides[slide].rider
        else {
            return None;
        };
        let turned = balance.known[block.0].iter().any(|item| item.couple.is_some())
            || self.mechanism.link(block).points.len() > 1
            || Self::rubs_at(balance, point);
        (self.is_arc(slide) && turned).then_some(block)
    }

    /// The line of a guide's force on what rides, through the place where the pin acts on it, and what of that force is
    /// known beforehand. The force of an arc passes through its centre: where something turns the block about its pin, the
    /// part across the line to the centre takes it up, M / R, as moments of the block tell; on a straight guide a couple does.
    pub(super) fn pressing_on(
        &mut self,
        balance: &Balance,
        slide: usize,
        (at, touch): (Point, Point),
    ) -> (Direction, Option<Item>) {
        let (_, normal) = self.pressing_at(balance, slide, at);
        let Some(block) = self.turned_on_arc(balance, slide) else { return (normal, None) };
        let Track::Arc(circle) = self.track(slide, None) else { return (normal, None) };
        let reason = self.reason(&[block, self.mechanism.slides[slide].guide.link]);
        let (inward, mm) = self.board.toward(touch, circle.centre, reason);
        let line = self.guide_force_as_drawn(slide, inward);
        let items = balance.on(block);
        let Some(moment) = self.moments(&items, touch) else { return (line, None) };
        let scale = self.length_scale();
        let arm = self.board.read(mm, scale);
        let size = self.board.quotient(moment, arm, reason);
        let size = self.board.opposite(size);
        let across = self.board.quarter_turn(line);
        let pull = self.pull_along(across, size);
        (line, Some(Item { pull: Some(pull), at: touch, couple: None }))
    }

    /// A force with the part of it that was known beforehand.
    fn with_known(&mut self, force: Pull, known: Option<Item>) -> Pull {
        let Some(known) = known.and_then(|item| item.pull) else { return force };
        let head = self.chained(&[force, known]);
        Pull { tail: self.board.origin(), head }
    }

    /// The sides of a sliding pair in which `pin` rides, itself or with a link of the group.
    pub(super) fn sliding(&self, slide: usize, link: Option<LinkId>) -> Sliding {
        let pair = self.mechanism.slides[slide];
        let rider = self.mechanism.party_of(&pair.rider);
        let guide = pair.guide.link;
        match (link, rider) {
            // The link carries the guide, and the other one rides.
            (Some(link), rider) if link == guide => {
                Sliding { inner: Some(link), outer: rider, inner_rides: false }
            }
            (_, Party::Link(block)) => {
                Sliding { inner: Some(block), outer: Party::Link(guide), inner_rides: true }
            }
            (_, Party::Pin(_)) => Sliding { inner: None, outer: Party::Link(guide), inner_rides: true },
        }
    }

    /// The sides of a sliding pair of a link that slides without turning: it rides, or carries the guide of what does.
    pub(super) fn sliding_link(&self, slide: usize, link: LinkId) -> Sliding {
        let pair = self.mechanism.slides[slide];
        let rider = self.mechanism.party_of(&pair.rider);
        let rides = rider == Party::Link(link);
        let outer = if rides { Party::Link(pair.guide.link) } else { rider };
        Sliding { inner: Some(link), outer, inner_rides: rides }
    }

    /// The direction of a guide under a point, and square to it.
    pub(in super::super) fn guide_at(&mut self, slide: usize, at: Point) -> (Direction, Direction) {
        match self.track(slide, None) {
            Track::Straight(line) => {
                let normal = self.board.quarter_turn(line.along);
                (line.along, normal)
            }
            Track::Arc(circle) => {
                let guide = self.mechanism.slides[slide].guide.link;
                let reason = self.reason(&[guide]);
                let (inward, _) = self.board.toward(at, circle.centre, reason);
                let along = self.board.quarter_turn(inward);
                (along, inward)
            }
        }
    }

    fn is_arc(&mut self, slide: usize) -> bool {
        matches!(self.mechanism.slides[slide].guide.path, crate::mechanism::Path::Arc { .. })
    }

    /// Notes the force of a sliding pair on its inner side, and lays it off on the outer one.
    pub(super) fn note_slide(
        &mut self,
        balance: &mut Balance,
        slide: usize,
        sliding: &Sliding,
        pin: PointId,
        on_inner: SlideForce,
    ) {
        let reaction = SlideForce {
            pull: Self::opposite(on_inner.pull),
            at: on_inner.at,
            couple: on_inner.couple.map(|couple| self.board.opposite(couple)),
        };
        balance.slides.insert(slide, if sliding.inner_rides { on_inner } else { reaction });
        if let (None, Party::Link(guide)) = (sliding.inner, sliding.outer) {
            // The pin itself rides: its slot is one of the parties at the pin.
            let pull = match balance.leaning.drag(slide) {
                // Of the guide on the pin, and turned round: the drag acts beside.
                Some(_) => {
                    let on_rider = if sliding.inner_rides { on_inner.pull } else { reaction.pull };
                    Self::opposite(self.with_drag(balance, slide, on_rider))
                }
                None => reaction.pull,
            };
            balance.of_pins.insert((pin.0, guide.0), pull);
        }
        balance.push_on(sliding.outer, reaction.item());
    }

    /// Notes the force of a pin on a link of the group, and lays it off on whoever holds the pin.
    pub(super) fn note_pin(&mut self, balance: &mut Balance, pin: PointId, link: LinkId, on_link: Pull) {
        let on_link = self.pin_force_as_used(pin, link, on_link);
        balance.of_pins.insert((pin.0, link.0), on_link);
        let at = self.touch_at(balance, pin, link);
        balance.push_on_pin(self, pin, Item { pull: Some(Self::opposite(on_link)), at, couple: None });
    }

    /// Notes the force of a pin between two links of one group: on the one of them that does not hold it.
    pub(super) fn note_inner_pin(&mut self, balance: &mut Balance, pin: PointId, of: [(LinkId, Pull); 2]) {
        let holder = self.holder(pin);
        for (link, pull) in of {
            if holder != super::Holder::Link(link) {
                balance.of_pins.insert((pin.0, link.0), pull);
            }
        }
    }

    /// −M of a body about a pin: the couple with which its guide keeps it from turning.
    pub(super) fn keeping(&mut self, items: &[Item], about: Point) -> Option<Amount> {
        let moment = self.moments(items, about)?;
        Some(self.board.opposite(moment))
    }

    /// The two sizes of forces along two lines that close a polygon: from the head of what is known along the first
    /// direction, and from there along the second one to the pole.
    pub(super) fn two_lines(
        &mut self,
        known: &[Pull],
        [first, second]: [Direction; 2],
        links: &[LinkId],
    ) -> [Pull; 2] {
        if known.is_empty() {
            let none = self.no_pull();
            return [none, none];
        }
        let tail = self.chained(known);
        let pole = self.board.origin();
        let reason = self.reason(links);
        let meet = self.board.meet_lines(
            Line { through: tail, along: first },
            Line { through: pole, along: second },
            reason,
        );
        [Pull { tail, head: meet.at }, Pull { tail: meet.at, head: pole }]
    }
}

/// Moments about the pin give the effort at the input.
fn driver(d: &mut Draughtsman<'_>, group: &Group, base: PointId, input: Drive, balance: &mut Balance) {
    let Some(&link) = group.links.iter().find(|link| !d.mechanism.link(**link).block) else {
        balance.refused = Some("a driven group has no link");
        return;
    };
    let items = balance.on(link);
    let about = d.touch_at(balance, base, link);
    let moments = d.moments(&items, about);
    d.note_effort(balance, input, moments, (&[link], base));
    let reaction = d.closing(&pulls(&items));
    d.note_pin(balance, base, link, reaction);
}

/// A link about a pin of a solved one that has the pin of its group, or a driven lever with what slides along it, which is
/// one body for all that acts from without.
#[derive(Debug, Clone, Copy)]
struct Leg {
    link: LinkId,
    base: PointId,
    /// How it is driven, and the link between it and the pin.
    ram: Option<(Ram, Option<LinkId>)>,
}

impl Leg {
    const fn of_link(link: LinkId, base: PointId) -> Self {
        Self { link, base, ram: None }
    }

    /// Its bodies: the link about the base first, that which has the pin last.
    fn bodies(self) -> Vec<LinkId> {
        [Some(self.link), self.ram.and_then(|(_, partner)| partner)].into_iter().flatten().collect()
    }

    /// The body that has the pin; the lever where the pin itself is driven along it.
    fn head(self) -> LinkId {
        self.ram.and_then(|(_, partner)| partner).unwrap_or(self.link)
    }

    /// What is known to act on it.
    fn items(self, balance: &Balance) -> Vec<Item> {
        self.bodies().into_iter().flat_map(|body| balance.on(body)).collect()
    }

    /// How it is driven, where the pin of its group itself is driven along it.
    fn bare(self) -> Option<Ram> {
        self.ram.filter(|(_, partner)| partner.is_none()).map(|(ram, _)| ram)
    }

    /// Notes that a driven lever on which nothing acts has two forces together with what is driven along it.
    fn note_member(self, pin: PointId, balance: &mut Balance) {
        if self.ram.is_some() && self.items(balance).is_empty() {
            balance.members.push((self.bodies(), [self.base, pin]));
        }
    }

    /// Notes its force at its base, when what acts on it at the pin of its group is known; of a driven lever the effort and
    /// the force of its sliding pair as well.
    fn balanced(self, d: &mut Draughtsman<'_>, balance: &mut Balance, pin: PointId, at_pin: Pull) {
        let mut all = pulls(&self.items(balance));
        all.push(at_pin);
        let reaction = d.closing(&all);
        if let Some((ram, partner)) = self.ram {
            let (input, lever) = (Drive::Input(ram.input), ram.lever);
            let mut items = balance.on_some(partner);
            let mut at = d.touch_at(balance, pin, self.head());
            let mut force = at_pin;
            if ram.slides(d.mechanism) {
                items = balance.on(lever);
                (at, force) = (d.touch_at(balance, self.base, lever), reaction);
            }
            items.push(Item { pull: Some(force), at, couple: None });
            slide_apart(d, ram.slide, input, &items, balance);
        }
        d.note_pin(balance, self.base, self.link, reaction);
    }
}

/// A driven lever and what else holds its pin.
fn driven_pin(
    d: &mut Draughtsman<'_>,
    pin: PointId,
    holds: [Hold; 2],
    riders: [Option<LinkId>; 2],
    balance: &mut Balance,
) {
    let leg = |d: &Draughtsman<'_>, hold: Hold, rider: Option<LinkId>| match hold {
        Hold::Rod { rod, base } => Some(Leg::of_link(rod, base)),
        Hold::Ram(ram) => {
            let partner = rider.or(match d.mechanism.party_of(&d.mechanism.slides[ram.slide].rider) {
                Party::Link(block) if block != ram.lever => Some(block),
                _ => None,
            });
            Some(Leg { link: ram.lever, base: ram.base, ram: Some((ram, partner)) })
        }
        Hold::Slide(_) | Hold::Contact { .. } => None,
    };
    let legs = [0, 1].map(|i| leg(d, holds[i], riders[i]));
    match (legs, holds[1]) {
        ([Some(first), Some(second)], _) => rrr(d, [first, second], pin, balance),
        ([Some(first), None], Hold::Slide(slide)) => rrp(d, first, pin, (slide, riders[1]), balance),
        ([Some(first), None], Hold::Contact { roll, wheel }) => {
            leaning(d, first, pin, (roll, wheel), balance)
        }
        _ => balance.refused = Some(NO_BALANCE),
    }
}

/// A driven lever whose pin is the centre of a wheel that rolls: moments about its base give how hard that presses.
fn leaning(
    d: &mut Draughtsman<'_>,
    leg: Leg,
    pin: PointId,
    (roll, wheel): (usize, LinkId),
    balance: &mut Balance,
) {
    let about = (leg.base, d.touch_at(balance, leg.base, leg.link));
    let (push, own) = rolling::pressing(d, (leg.bodies(), leg.head()), (roll, wheel), about, balance);
    leg.note_member(pin, balance);
    leg.balanced(d, balance, pin, push);
    // After that: a wheel that is balanced already hands the push on to the pin.
    let contact = d.contact_at(roll);
    d.presses(balance, roll, (own, leg.head()), push, &contact);
}

/// The polygon of what rides, with the line of the guide and the line square to it.
fn driven_slide(d: &mut Draughtsman<'_>, slide: usize, input: Drive, balance: &mut Balance) {
    let Some(pin) = d.mechanism.pin_of_slide(slide) else {
        balance.refused = Some("a sliding link has no joint");
        return;
    };
    let items = match d.mechanism.party_of(&d.mechanism.slides[slide].rider) {
        Party::Link(link) => balance.on(link),
        Party::Pin(_) => match d.holder(pin) {
            super::Holder::Link(link) => balance.on(link),
            super::Holder::Pin => balance.on_pin(pin),
        },
    };
    slide_apart(d, slide, input, &items, balance);
}

/// The effort and the force of a driven slide, of what else acts on the rider.
fn slide_apart(d: &mut Draughtsman<'_>, slide: usize, input: Drive, items: &[Item], balance: &mut Balance) {
    let pair = d.mechanism.slides[slide];
    let sliding = Sliding {
        inner: match d.mechanism.party_of(&pair.rider) {
            Party::Link(link) => Some(link),
            Party::Pin(_) => None,
        },
        outer: Party::Link(pair.guide.link),
        inner_rides: true,
    };
    let Some(pin) = d.mechanism.pin_of_slide(slide) else {
        balance.refused = Some("a sliding link has no joint");
        return;
    };
    let at = d.at(pin);
    let (along, normal) = d.pressing_at(balance, slide, at);
    let [across, drive] = d.two_lines(&pulls(items), [normal, along], &[pair.guide.link]);
    let couple = if sliding.inner.is_some() { d.keeping(items, at) } else { None };
    let [dx, dy] = d.board.between(drive.tail, drive.head);
    let scale = d.force_scale();
    let (x, y) = (d.board.read(dx, scale), d.board.read(dy, scale));
    let unit = d.board.amount(crate::given::Given::exact(1.0));
    let [ax, ay] = d.board.components(along, unit);
    let (px, py) = (d.board.product(x, ax), d.board.product(y, ay));
    let effort = d.board.sum(px, py);
    balance.note_effort(input, effort);
    // The drive stands between rider and carrier as well, and is no force of the pair.
    balance.push_on(sliding.outer, Item { pull: Some(Draughtsman::opposite(drive)), at, couple: None });
    d.note_slide(balance, slide, &sliding, pin, SlideForce { pull: across, at, couple });
}

/// Components at the inner pin; the links with nothing on them first, so that the line of their force is that of
/// their pins.
fn rrr(d: &mut Draughtsman<'_>, legs: [Leg; 2], pin: PointId, balance: &mut Balance) {
    let mut items = legs.map(|leg| leg.items(balance));
    // A pin that no leg holds is taken with the first of them.
    if d.holder(pin) == super::Holder::Pin {
        items[0].extend(balance.on_pin(pin));
    }
    let order = if items[1].is_empty() || !items[0].is_empty() { [0, 1] } else { [1, 0] };
    let [(leg_a, on_a), (leg_b, on_b)] = order.map(|i| (legs[i], items[i].clone()));
    let (base_a, base_b) = (leg_a.base, leg_b.base);
    let (at_a, at_b) = (d.touch_at(balance, base_a, leg_a.link), d.touch_at(balance, base_b, leg_b.link));
    let (a, b) = (leg_a.head(), leg_b.head());
    let at = d.inner_touch(balance, pin, [a, b]);
    let reason = d.reason(&[a, b]);
    let (along, _) = d.board.toward(at_b, at, reason);
    let line = Line { through: at, along };
    let on_b_at_pin = match d.by_three_forces(balance, a, (&on_a, &on_b), line, at_a) {
        Some(on_a_at_pin) => Draughtsman::opposite(on_a_at_pin),
        None => {
            let across = d.board.quarter_turn(along);
            // Moments of one link about its base give the part across it.
            let moments = d.moments(&on_b, at_b);
            let tangential = moments.map(|moments| {
                let line = Line { through: at, along: across };
                d.balancing(Some(moments), line, at_b, &[b])
            });
            note_moments(d, [leg_a, leg_b], tangential.is_none(), pin, balance);
            // Moments of the other one about its base give the part along the first.
            let mut turning = d.moments(&on_a, at_a);
            if let Some(size) = tangential {
                let arm = d.arm_of(Line { through: at, along: across }, at_a);
                let moment = d.board.product(size, arm);
                let back = d.board.opposite(moment);
                turning = d.both(turning, Some(back));
            }
            let size = d.balancing(turning, line, at_a, &[a, b]);
            let normal = d.board.opposite(size);
            let normal = d.pull_along(along, normal);
            let mut parts = Vec::new();
            if let Some(size) = tangential {
                parts.push(d.pull_along(across, size));
            }
            parts.push(normal);
            let head = d.chained(&parts);
            Pull { tail: d.board.origin(), head }
        }
    };
    let on_b_at_pin = d.pin_force_as_used(pin, b, on_b_at_pin);
    let on_a_at_pin = Draughtsman::opposite(on_b_at_pin);
    d.note_inner_pin(balance, pin, [(a, on_a_at_pin), (b, on_b_at_pin)]);
    leg_b.balanced(d, balance, pin, on_b_at_pin);
    leg_a.balanced(d, balance, pin, on_a_at_pin);
}

/// Notes for the reader the moments of two legs about their bases: of the second one for the part of its force across it, of
/// the first one for the part along the second.
fn note_moments(
    d: &mut Draughtsman<'_>,
    [leg_a, leg_b]: [Leg; 2],
    whole: bool,
    pin: PointId,
    balance: &mut Balance,
) {
    for leg in [leg_a, leg_b] {
        leg.note_member(pin, balance);
    }
    let taken = |leg: Leg, found| Taken { links: leg.bodies(), about: About::Point(leg.base), found };
    let (first, second) = match (leg_a.bare(), leg_b.bare()) {
        (None, None) => {
            let (a, b) = (leg_a.head(), leg_b.head());
            let across = TakenFor::Across { pin, by: a, on: b, from: leg_b.base };
            let along = TakenFor::Along { pin, by: b, on: a, from: leg_b.base, whole };
            ((!whole).then(|| taken(leg_b, across)), Some(taken(leg_a, along)))
        }
        (Some(_), Some(_)) => return,
        (Some(ram), None) | (None, Some(ram)) => {
            // What drives a bare pin is no force of its pair: moments of the lever give what presses on its guide, those of
            // the other leg then what drives.
            let (lever, other) = if leg_a.bare().is_some() { (leg_a, leg_b) } else { (leg_b, leg_a) };
            if !d.guide_passes(ram.slide, ram.base) {
                // Both turn the lever: its moments give a part of what the pin passes on in all.
                balance.whole_pins.push((pin, lever.link));
                let (a, b) = (leg_a.head(), leg_b.head());
                let across = TakenFor::Across { pin, by: a, on: b, from: leg_b.base };
                let along = TakenFor::Along { pin, by: b, on: a, from: leg_b.base, whole };
                balance.taken.extend((!whole).then(|| taken(leg_b, across)));
                balance.taken.push(taken(leg_a, along));
                return;
            }
            let loaded = |leg: Leg, balance: &Balance| !leg.items(balance).is_empty();
            (
                loaded(lever, balance).then(|| taken(lever, TakenFor::Slot(ram.slide))),
                loaded(other, balance).then(|| taken(other, TakenFor::Driven(ram.input))),
            )
        }
    };
    balance.taken.extend(first.into_iter().chain(second));
}

/// A rod and what slides: moments of both about the rod's pin give the force of the guide.
fn rrp(
    d: &mut Draughtsman<'_>,
    leg: Leg,
    pin: PointId,
    (slide, rider): (usize, Option<LinkId>),
    balance: &mut Balance,
) {
    let sliding = d.sliding(slide, rider);
    let (rod, base) = (leg.head(), leg.base);
    let mut on_rod = leg.items(balance);
    if sliding.inner.is_none() && d.holder(pin) == super::Holder::Pin {
        on_rod.extend(balance.on_pin(pin));
    }
    let on_rider = balance.on_some(sliding.inner);
    let (at_base, at) = (d.touch_at(balance, base, leg.link), d.at(pin));
    // Where the rod acts on what slides.
    let touch = sliding.inner.map_or(at, |rider| d.inner_touch(balance, pin, [rod, rider]));
    let (normal, across) = d.pressing_on(balance, slide, (at, touch));
    let rubs = Draughtsman::rubs_at(balance, pin);
    let couple = if rubs { None } else { d.keeping(&on_rider, at) };
    let rod_moments = d.moments(&on_rod, at_base);
    let polygon = rod_moments.is_none() && sliding.inner.is_some();
    let line = Line { through: touch, along: normal };
    let felt: Vec<Item> = on_rider.iter().copied().chain(across).collect();
    let three = match polygon {
        true => None,
        false => d.by_three_forces(balance, rod, (&on_rod, &felt), line, at_base),
    };
    leg.note_member(pin, balance);
    let of_guide = if let Some(of_guide) = three {
        of_guide
    } else if polygon && !d.asks_components(rod) {
        // A member of two forces: its line is that of its pins.
        let reason = d.reason(&[rod]);
        let (along, _) = d.board.toward(at_base, touch, reason);
        let [guide, _] = d.two_lines(&pulls(&felt), [normal, along], &[rod]);
        guide
    } else {
        let rider_force = pulls(&felt);
        let mut moments = rod_moments;
        if !rider_force.is_empty() {
            let head = d.chained(&rider_force);
            let tail = d.board.origin();
            let of_rider = d.moment_of(Pull { tail, head }, touch, at_base);
            moments = d.both(moments, Some(of_rider));
        }
        let size = d.balancing(moments, line, at_base, &[rod]);
        let links = leg.bodies().into_iter().chain(sliding.inner).collect();
        balance.taken.push(Taken { links, about: About::Point(base), found: TakenFor::Slide(slide) });
        d.pull_along(normal, size)
    };
    let of_guide = d.with_known(of_guide, across);
    let of_guide = d.slide_force_as_used(slide, sliding.inner, of_guide);
    let couple = match sliding.inner {
        Some(_) if rubs => {
            let mut all = on_rider.clone();
            let mut forces = pulls(&on_rider);
            forces.push(of_guide);
            all.push(Item { pull: Some(d.closing(&forces)), at: touch, couple: None });
            d.keeping(&all, at)
        }
        _ => couple,
    };
    let on_inner = SlideForce { pull: of_guide, at, couple };
    d.note_slide(balance, slide, &sliding, pin, on_inner);
    let at_pin = match sliding.inner {
        Some(rider) => {
            let mut all = pulls(&on_rider);
            all.push(of_guide);
            let on_rider_at_pin = d.closing(&all);
            let on_rod_at_pin = Draughtsman::opposite(on_rider_at_pin);
            let on_rod_at_pin = d.pin_force_as_used(pin, rod, on_rod_at_pin);
            d.note_inner_pin(balance, pin, [(rod, on_rod_at_pin), (rider, on_rider_at_pin)]);
            on_rod_at_pin
        }
        None => of_guide,
    };
    leg.balanced(d, balance, pin, at_pin);
}

/// A lever and what slides in it: moments of the lever about its pin give the force square to the slot.
fn rpr(
    d: &mut Draughtsman<'_>,
    (lever, base): (LinkId, PointId),
    pin: PointId,
    (slide, rod): (usize, Option<LinkId>),
    balance: &mut Balance,
) {
    let sliding = d.sliding(slide, rod);
    let on_lever = balance.on(lever);
    let inner = sliding.inner.map(|link| (link, balance.on(link)));
    let (at_base, at) = (d.touch_at(balance, base, lever), d.at(pin));
    // Where the pin acts on the inner body.
    let touch = sliding.inner.map_or(at, |link| d.touch_at(balance, pin, link));
    let rubs = sliding.inner.is_some() && Draughtsman::rubs_at(balance, pin);
    let (normal, across) = d.pressing_on(balance, slide, (at, touch));
    let on_inner = balance.on_some(sliding.inner);
    let felt = across.map(|item| Item { pull: item.pull.map(Draughtsman::opposite), ..item });
    let lever_and_felt: Vec<Item> = on_lever.iter().copied().chain(felt).collect();
    // What would turn the inner body is kept by the lever, which feels it.
    let couple = d.keeping(&on_inner, at);
    let turned = if rubs { d.moments(&on_inner, touch) } else { d.moments(&on_inner, at) };
    let line = Line { through: touch, along: normal };
    let on_lever_force = match d.by_three_forces(balance, lever, (&lever_and_felt, &on_inner), line, at_base)
    {
        Some(on_lever_force) => on_lever_force,
        None => {
            let moments = d.moments(&lever_and_felt, at_base);
            let moments = d.both(moments, turned);
            let size = d.balancing(moments, line, at_base, &[lever]);
            let found = TakenFor::Slot(slide);
            balance.taken.push(Taken { links: vec![lever], about: About::Point(base), found });
            d.pull_along(normal, size)
        }
    };
    let on_inner_force = Draughtsman::opposite(on_lever_force);
    let on_inner_force = d.with_known(on_inner_force, across);
    let on_inner_force = d.slide_force_as_used(slide, sliding.inner, on_inner_force);
    let on_lever_force = Draughtsman::opposite(on_inner_force);
    let couple = if rubs {
        let mut all = on_inner.clone();
        let mut forces = pulls(&on_inner);
        forces.push(on_inner_force);
        all.push(Item { pull: Some(d.closing(&forces)), at: touch, couple: None });
        d.keeping(&all, at)
    } else {
        couple
    };
    let item = SlideForce { pull: on_inner_force, at, couple };
    d.note_slide(balance, slide, &sliding, pin, item);
    let at_pin = match inner {
        Some((link, items)) => {
            let mut all = pulls(&items);
            all.push(on_inner_force);
            let of_pin = d.closing(&all);
            d.note_pin(balance, pin, link, of_pin);
            None
        }
        None => Some(on_lever_force),
    };
    if let Some(force) = at_pin {
        // The pin itself rides: what the slot does to it, whoever holds the pin feels.
        let reaction = Item { pull: Some(Draughtsman::opposite(force)), at, couple: None };
        balance.push_on_pin(d, pin, reaction);
    }
    let mut all = pulls(&on_lever);
    all.push(on_lever_force);
    let reaction = d.closing(&all);
    d.note_pin(balance, base, lever, reaction);
}

/// A pin on two guides: a polygon with two known lines.
fn prp(
    d: &mut Draughtsman<'_>,
    pin: PointId,
    slides: [usize; 2],
    riders: [Option<LinkId>; 2],
    balance: &mut Balance,
) {
    let at = d.at(pin);
    let sides = [0, 1].map(|i| d.sliding(slides[i], riders[i]));
    let mut bodies: Vec<LinkId> = sides.iter().filter_map(|side| side.inner).collect();
    bodies.dedup();
    let mut all = pulls(&balance.on_pin(pin));
    for body in &bodies {
        all.extend(pulls(&balance.on(*body)));
    }
    let pressing = [0, 1].map(|i| {
        let touch = sides[i].inner.map_or(at, |link| d.touch_at(balance, pin, link));
        d.pressing_on(balance, slides[i], (at, touch))
    });
    let (normals, across) = (pressing.map(|(normal, _)| normal), pressing.map(|(_, across)| across));
    all.extend(across.iter().flatten().filter_map(|item| item.pull));
    let rubs = Draughtsman::rubs_at(balance, pin);
    let guides = sides.each_ref().map(|side| match side.outer {
        Party::Link(link) => link,
        Party::Pin(_) => LinkId::FRAME,
    });
    let along = d.two_lines(&all, normals, &guides);
    let forces = [0, 1].map(|i| d.with_known(along[i], across[i]));
    let one_body = sides[0].inner == sides[1].inner && sides[0].inner.is_some();
    if bodies.len() > 1 && !all.is_empty() {
        balance.as_one.push(bodies.clone());
    }
    for i in 0..2 {
        let items = balance.on_some(sides[i].inner);
        let couple = match sides[i].inner {
            _ if one_body && i == 1 => None,
            Some(link) if rubs && !one_body => {
                let mut all = items.clone();
                let mut of_body = pulls(&items);
                of_body.push(forces[i]);
                let touch = d.touch_at(balance, pin, link);
                all.push(Item { pull: Some(d.closing(&of_body)), at: touch, couple: None });
                d.keeping(&all, at)
            }
            _ => d.keeping(&items, at),
        };
        let on_inner = SlideForce { pull: forces[i], at, couple };
        d.note_slide(balance, slides[i], &sides[i], pin, on_inner);
        if let (Some(link), false) = (sides[i].inner, one_body) {
            let mut of_body = pulls(&items);
            of_body.push(forces[i]);
            let of_pin = d.closing(&of_body);
            if d.holder(pin) != super::Holder::Link(link) {
                balance.of_pins.insert((pin.0, link.0), of_pin);
            }
        }
    }
}

/// A link between two sliding pairs and a pinned one: the polygon of the link has two known lines.
fn rpp(
    d: &mut Draughtsman<'_>,
    (link, point): (LinkId, PointId),
    (lever, base): (LinkId, PointId),
    [ride, slot]: [usize; 2],
    balance: &mut Balance,
) {
    let (on_link, on_lever) = (balance.on(link), balance.on(lever));
    let (at, at_base) = (d.at(point), d.at(base));
    let (_, of_ride) = d.pressing_at(balance, ride, at);
    let (_, of_slot) = d.pressing_at(balance, slot, at_base);
    let rubs = Draughtsman::rubs_at(balance, base);
    // The force of the slot is told through the lever's pin: what is left of moments there is its couple.
    let on_lever_couple = if rubs { None } else { d.keeping(&on_lever, at_base) };
    let all = [pulls(&on_link), pulls(&on_lever)];
    // The lever passes only what is along the normal of the slot; the rest goes to its pin.
    let [of_slot_on_link, of_ride_on_link] = d.two_lines(&all[0], [of_slot, of_ride], &[link]);
    let on_lever_force = Draughtsman::opposite(of_slot_on_link);
    let on_lever_couple = if rubs {
        let mut about = on_lever.clone();
        let mut forces = pulls(&on_lever);
        forces.push(on_lever_force);
        let touch = d.touch_at(balance, base, lever);
        about.push(Item { pull: Some(d.closing(&forces)), at: touch, couple: None });
        d.keeping(&about, at_base)
    } else {
        on_lever_couple
    };
    let slot_side = d.sliding_link(slot, link);
    let on_link_couple = on_lever_couple.map(|couple| d.board.opposite(couple));
    let slot_item = SlideForce { pull: of_slot_on_link, at: at_base, couple: on_link_couple };
    d.note_slide(balance, slot, &slot_side, base, slot_item);
    let mut about_point = on_link.clone();
    about_point.push(slot_item.item());
    let couple = d.keeping(&about_point, at);
    let ride_side = d.sliding_link(ride, link);
    let ride_item = SlideForce { pull: of_ride_on_link, at, couple };
    d.note_slide(balance, ride, &ride_side, point, ride_item);
    let mut of_lever = all[1].clone();
    of_lever.push(on_lever_force);
    let reaction = d.closing(&of_lever);
    d.note_pin(balance, base, lever, reaction);
}

/// A link that slides on one body and carries a slot for the pin of another: a polygon with two known lines.
fn yoke(
    d: &mut Draughtsman<'_>,
    link: LinkId,
    ride: usize,
    (pin, slot): (PointId, usize),
    balance: &mut Balance,
) {
    let sliding = d.sliding(slot, None);
    let on_link = balance.on(link);
    let on_block = balance.on_some(sliding.inner);
    let at_pin = d.at(pin);
    let Some(&first) = d.mechanism.link(link).points.first() else {
        balance.refused = Some("a sliding link has no joint");
        return;
    };
    let at = d.at(first);
    let touch = sliding.inner.map_or(at_pin, |block| d.touch_at(balance, pin, block));
    let (of_slot, across) = d.pressing_on(balance, slot, (at_pin, touch));
    let (_, of_ride) = d.pressing_at(balance, ride, at);
    let mut on_yoke = pulls(&on_link);
    on_yoke.extend(across.and_then(|item| item.pull).map(Draughtsman::opposite));
    let [slot_force, ride_force] = d.two_lines(&on_yoke, [of_slot, of_ride], &[link]);
    // The slot's force on the yoke is that of the block, or of the pin, turned round.
    let on_inner = d.with_known(Draughtsman::opposite(slot_force), across);
    let slot_force = Draughtsman::opposite(on_inner);
    let block_couple = match sliding.inner {
        Some(block) if Draughtsman::rubs_at(balance, pin) => {
            let mut all = on_block.clone();
            let mut forces = pulls(&on_block);
            forces.push(on_inner);
            let touch = d.touch_at(balance, pin, block);
            all.push(Item { pull: Some(d.closing(&forces)), at: touch, couple: None });
            d.keeping(&all, at_pin)
        }
        _ => d.keeping(&on_block, at_pin),
    };
    let mut about = on_link.clone();
    let felt = block_couple.map(|couple| d.board.opposite(couple));
    about.push(Item { pull: Some(slot_force), at: at_pin, couple: felt });
    let couple = d.keeping(&about, at);
    let item = SlideForce { pull: on_inner, at: at_pin, couple: block_couple };
    d.note_slide(balance, slot, &sliding, pin, item);
    match sliding.inner {
        Some(block) => {
            let mut all = pulls(&on_block);
            all.push(on_inner);
            let of_pin = d.closing(&all);
            d.note_pin(balance, pin, block, of_pin);
        }
        None => {
            balance.push_on_pin(d, pin, Item { pull: Some(on_inner), at: at_pin, couple: None });
        }
    }
    let side = d.sliding_link(ride, link);
    d.note_slide(balance, ride, &side, first, SlideForce { pull: ride_force, at, couple });
}

impl Draughtsman<'_> {
    /// Whether a guide passes through a point, as it is drawn.
    fn guide_passes(&mut self, slide: usize, point: PointId) -> bool {
        let at = self.at(point);
        let Track::Straight(line) = self.track(slide, None) else { return false };
        self.arm_of(line, at).value().abs() < NO_ARM * self.length_scale().si_per_mm
    }
}
