//! Rolling pairs: the force along the common tangent, what teeth push apart, and how hard a pair presses that keeps its
//! own contact.

use crate::board::{Amount, Direction, Line, Point};
use crate::given::Given;
use crate::mechanism::force::Share;
use crate::mechanism::structure::{Drive, Joint};
use crate::mechanism::{LinkId, PointId, Roll};

use super::super::draughtsman::Draughtsman;
use super::{About, Balance, Item, Pull, SlideForce, Taken, TakenFor, pulls};

/// A contact would have to pull.
pub(in super::super) const PULLS: &str =
    "no equilibrium: two links that roll on each other would have to pull to keep their contact";

/// A contact that would pull with less than this part of the largest force rests.
const FAINT: f64 = 1e-9;

const RUBS: &str =
    "this version does not draw friction at the pin of a wheel that is kept in its place by its contact";

/// Teeth and friction in a group that is balanced by trial, or in whose guide the centre of a driven wheel rides.
pub(super) const TOOTHED: &str = "this version does not draw friction beside the teeth of this group";

/// The force of a rolling pair on the second of its bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct RollForce {
    pub(super) pull: Pull,
    pub(super) at: Point,
}

impl RollForce {
    pub(super) fn item(self) -> Item {
        Item { pull: Some(self.pull), at: self.at, couple: None }
    }
}

/// Where two bodies touch.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub(super) at: Point,
    /// The common tangent.
    pub(super) tangent: Direction,
    /// Where the first body pushes the second one.
    pub(super) push: Direction,
}

impl Draughtsman<'_> {
    /// Where the bodies of a rolling pair touch, and their common tangent.
    pub(super) fn contact_at(&mut self, roll: usize) -> Contact {
        let point = self.mechanism.contacts[roll];
        let [first, _] = self.mechanism.rolls[roll].bodies();
        if self.places[point.0].is_none() {
            self.contact(first, roll);
        }
        let at = self.at(point);
        let reason = self.reason(&self.mechanism.rolls[roll].bodies());
        let push = match self.mechanism.rolls[roll] {
            Roll::Circles { centres, internal, .. } => {
                let [a, b] = centres.map(|centre| self.at(centre));
                let (along, _) = self.board.toward(a, b, reason);
                if internal { self.board.reverse(along) } else { along }
            }
            Roll::Line { centre, .. } => {
                let centre = self.at(centre);
                self.board.toward(at, centre, reason).0
            }
        };
        Contact { at, tangent: self.board.quarter_turn(push), push }
    }

    /// Whether a rolling pair keeps its own contact, which nothing else does.
    pub(super) fn keeps_contact(&self, roll: usize) -> bool {
        self.structure.groups.iter().any(|group| group.joints.contains(&Joint::Contact(roll)))
    }

    /// The whole force of a rolling pair on one of its bodies, of which the part along the tangent is known: teeth whose
    /// distance is held lean by the angle of pressure, so that both wheels are pushed apart, whichever way they drive.
    pub(super) fn rolling_pull(
        &mut self,
        balance: &Balance,
        (roll, on): (usize, LinkId),
        contact: &Contact,
        size: Amount,
    ) -> Pull {
        let along = self.pull_along(contact.tangent, size);
        let Some(pressure) = self.mechanism.forces.pressure(roll).filter(|_| !self.keeps_contact(roll))
        else {
            return along;
        };
        let angle = self.board.angle(pressure);
        let leaning = self.board.protractor(angle);
        let unit = self.board.amount(Given::exact(1.0));
        let [cosine, sine] = self.board.components(leaning, unit);
        let reason = self.reason(&[on]);
        let tangent = self.board.quotient(sine, cosine, reason);
        let apart = match self.flank_on(balance, roll, on) {
            Some(flank) => {
                let tangent = self.board.in_sense_of(tangent, flank, reason);
                self.board.product(size, tangent)
            }
            None => {
                // Where the drawing is run for other places teeth may drive by their other flank there.
                let size = match self.board.tape().will_be_run() {
                    true => {
                        let square = self.board.product(size, size);
                        self.board.root(square)
                    }
                    false => self.board.magnitude(size),
                };
                self.board.product(size, tangent)
            }
        };
        let [_, second] = self.mechanism.rolls[roll].bodies();
        let outward = if on == second { contact.push } else { self.board.reverse(contact.push) };
        let apart = self.pull_along(outward, apart);
        let head = self.chained(&[along, apart]);
        Pull { tail: self.board.origin(), head }
    }

    /// In which sense teeth drove one of their bodies when the forces were drawn before, where that counts.
    fn flank_on(&mut self, balance: &Balance, roll: usize, on: LinkId) -> Option<Amount> {
        let flank = balance.leaning.flank(roll)?;
        let [_, second] = self.mechanism.rolls[roll].bodies();
        Some(if on == second { flank } else { self.board.opposite(flank) })
    }

    /// Whether teeth of a rolling pair push its bodies apart.
    pub(super) fn leans_by_teeth(&self, roll: usize) -> bool {
        self.mechanism.forces.pressure(roll).is_some() && !self.keeps_contact(roll)
    }

    /// The line of the whole force of teeth on one of two bodies, which drive in the sense of a force along the tangent. None
    /// where they drive with no more than rounding: nobody knows by which flank, and they push apart no more than that.
    pub(super) fn line_of_teeth(
        &mut self,
        balance: &Balance,
        (roll, on): (usize, LinkId),
        contact: &Contact,
        size: Amount,
    ) -> Option<Line> {
        let Some(pressure) = self.mechanism.forces.pressure(roll).filter(|_| self.leans_by_teeth(roll))
        else {
            return Some(Line { through: contact.at, along: contact.tangent });
        };
        let angle = self.board.angle(pressure);
        let leaning = self.board.protractor(angle);
        let unit = self.board.amount(Given::exact(1.0));
        let [cosine, sine] = self.board.components(leaning, unit);
        let reason = self.reason(&[on]);
        let driven = self.flank_on(balance, roll, on).unwrap_or(size);
        let apart = self.board.in_sense_of(sine, driven, reason);
        if self.board.is_weak(apart) && !self.board.tape().will_be_run() {
            return None;
        }
        let [_, second] = self.mechanism.rolls[roll].bodies();
        let outward = if on == second { contact.push } else { self.board.reverse(contact.push) };
        let scale = self.force_scale();
        let (cosine, apart) = (self.board.to_paper(cosine, scale), self.board.to_paper(apart, scale));
        let pole = self.board.origin();
        let foot = self.board.lay_off(pole, contact.tangent, cosine);
        let tip = self.board.lay_off(foot, outward, apart);
        let (along, _) = self.board.toward(pole, tip, reason);
        Some(Line { through: contact.at, along })
    }

    /// Notes a part of the force of a rolling pair on one of its bodies.
    fn note_roll(&mut self, balance: &mut Balance, roll: usize, (on, pull): (LinkId, Pull), at: Point) {
        let [_, second] = self.mechanism.rolls[roll].bodies();
        let on_second = if on == second { pull } else { Self::opposite(pull) };
        let pull = match balance.rolls.get(&roll) {
            Some(before) => {
                let head = self.chained(&[before.pull, on_second]);
                Pull { tail: self.board.origin(), head }
            }
            None => on_second,
        };
        balance.rolls.insert(roll, RollForce { pull, at });
    }

    /// Lays a part of the force of a rolling pair on one of its bodies. Where the body is balanced already it is a wheel
    /// about whose centre the part has no moment: its pin hands it on.
    fn push_rolling(&mut self, balance: &mut Balance, roll: usize, (on, pull): (LinkId, Pull), at: Point) {
        let item = Item { pull: Some(pull), at, couple: None };
        if !balance.balanced.contains(&on) {
            balance.known[on.0].push(item);
            return;
        }
        let centre = match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } if links[0] == on => centres[0],
            Roll::Circles { centres, .. } => centres[1],
            Roll::Line { centre, .. } => centre,
        };
        if let Some(before) = balance.of_pins.get(&(centre.0, on.0)).copied() {
            let head = self.chained(&[before, Self::opposite(pull)]);
            let tail = self.board.origin();
            balance.of_pins.insert((centre.0, on.0), Pull { tail, head });
        }
        let at = self.at(centre);
        balance.push_on_pin(self, centre, Item { pull: Some(pull), at, couple: None });
    }

    /// Notes a force of a rolling pair that was found on one of its bodies, and lays it on the other.
    pub(super) fn rolls_on(
        &mut self,
        balance: &mut Balance,
        roll: usize,
        (on, pull): (LinkId, Pull),
        at: Point,
    ) {
        self.note_roll(balance, roll, (on, pull), at);
        let [first, second] = self.mechanism.rolls[roll].bodies();
        let other = if on == second { first } else { second };
        self.push_rolling(balance, roll, (other, Self::opposite(pull)), at);
    }

    /// Lays a force of a rolling pair on both of its bodies.
    pub(super) fn rolls_between(
        &mut self,
        balance: &mut Balance,
        roll: usize,
        (on, pull): (LinkId, Pull),
        at: Point,
    ) {
        self.rolls_on(balance, roll, (on, pull), at);
        self.push_rolling(balance, roll, (on, pull), at);
    }

    /// How hard a pair presses that keeps its contact, found in the balance of a link: that of the wheel, or one that
    /// carries the wheel's centre and to which its pin hands the force on.
    pub(super) fn presses(
        &mut self,
        balance: &mut Balance,
        roll: usize,
        (wheel, link): (LinkId, LinkId),
        pull: Pull,
        contact: &Contact,
    ) {
        let [_, second] = self.mechanism.rolls[roll].bodies();
        let outward = if wheel == second { contact.push } else { self.board.reverse(contact.push) };
        let pull = self.only_pushing(balance, pull, outward);
        self.rolls_on(balance, roll, (wheel, pull), contact.at);
        if wheel != link {
            self.push_rolling(balance, roll, (wheel, pull), contact.at);
        }
    }

    /// In a drawing that is run for other places, a force that is none where it would have to pull.
    fn only_pushing(&mut self, balance: &Balance, pull: Pull, outward: Direction) -> Pull {
        if !balance.judges() || !self.board.tape().will_be_run() {
            return pull;
        }
        let parts = self.components_of(pull);
        let push = self.part_along(parts, outward);
        // What rests does not pull.
        let size = self.board.magnitude(push);
        let (twice, faint) = (Given::exact(2.0), Given::exact(FAINT));
        let (twice, faint) = (self.board.amount(twice), self.board.amount(faint));
        let most = self.board.product(twice, size);
        let room = self.board.product(most, faint);
        let least = self.board.sum(room, faint);
        let pushes = self.board.sum(push, least);
        let scale = self.force_scale();
        let parts = parts.map(|part| {
            let part = self.only_where(part, pushes);
            self.board.to_paper(part, scale)
        });
        let tail = self.board.origin();
        Pull { tail, head: self.board.moved(tail, parts) }
    }

    /// Refuses a balance in which a pair that keeps its contact would have to pull.
    pub(super) fn judge_contacts(&mut self, balance: &mut Balance) {
        // Whoever errs does not ask whether a contact would have to pull in what he has drawn.
        if !balance.judges() || balance.refused.is_some() || !self.departures.is_empty() {
            return;
        }
        let size = |pull: Pull| {
            let ([x, y], [from_x, from_y]) = (pull.head.value(), pull.tail.value());
            libm::hypot(x - from_x, y - from_y)
        };
        let slides = balance.slides.values().map(|force| force.pull);
        let rolls = balance.rolls.values().map(|force| force.pull);
        let all = balance.of_pins.values().copied().chain(slides).chain(rolls);
        let largest = all.map(size).fold(0.0_f64, f64::max);
        for (roll, force) in balance.rolls.clone() {
            if !self.keeps_contact(roll) {
                continue;
            }
            let contact = self.contact_at(roll);
            let ([x, y], [from_x, from_y]) = (force.pull.head.value(), force.pull.tail.value());
            let [nx, ny] = contact.push.value();
            if (x - from_x) * nx + (y - from_y) * ny < -FAINT * largest {
                balance.refused = Some(PULLS);
            }
        }
    }
}

/// A wheel: moments about its centre give the force along the common tangent.
pub(super) fn wheel(
    d: &mut Draughtsman<'_>,
    (wheel, centre): (LinkId, PointId),
    roll: usize,
    balance: &mut Balance,
) {
    let rubs = Draughtsman::rubs_at(balance, centre);
    if rubs && d.keeps_contact(roll) {
        balance.refused = Some(RUBS);
        return;
    }
    let items = balance.on(wheel);
    let about = d.touch_at(balance, centre, wheel);
    let contact = d.contact_at(roll);
    let moments = d.moments(&items, about);
    let size = d.balancing(moments, Line { through: contact.at, along: contact.tangent }, about, &[wheel]);
    // What pushes apart passes by the point where the pin touches its circle.
    let inclined = match moments {
        Some(_) if rubs && d.leans_by_teeth(roll) => d.line_of_teeth(balance, (roll, wheel), &contact, size),
        _ => None,
    };
    let pull = match inclined {
        Some(line) => {
            let size = d.balancing(moments, line, about, &[wheel]);
            d.pull_along(line.along, size)
        }
        None => d.rolling_pull(balance, (roll, wheel), &contact, size),
    };
    d.rolls_on(balance, roll, (wheel, pull), contact.at);
    balance.taken.push(Taken {
        links: vec![wheel],
        about: About::Point(centre),
        found: TakenFor::Roll { roll, on: wheel, presses: false },
    });
    let mut all = pulls(&items);
    all.push(pull);
    let reaction = d.closing(&all);
    d.note_pin(balance, centre, wheel, reaction);
}

/// A rack in a guide: a polygon with two known lines, square to the guide and along the rack.
pub(super) fn rack(
    d: &mut Draughtsman<'_>,
    (link, ride): (LinkId, usize),
    roll: usize,
    balance: &mut Balance,
) {
    let Some(&first) = d.mechanism.link(link).points.first() else {
        balance.refused = Some("a sliding link has no joint");
        return;
    };
    let items = balance.on(link);
    let at = d.at(first);
    let contact = d.contact_at(roll);
    let (_, normal) = d.pressing_at(balance, ride, at);
    let [_, along] = d.two_lines(&pulls(&items), [normal, contact.tangent], &[link]);
    let parts = d.components_of(along);
    let size = d.part_along(parts, contact.tangent);
    // What pushes apart makes the guide rub.
    let inclined = if balance.leaning.leans(ride) && d.leans_by_teeth(roll) && !items.is_empty() {
        d.line_of_teeth(balance, (roll, link), &contact, size)
    } else {
        None
    };
    let pull = match inclined {
        Some(line) => {
            let [_, whole] = d.two_lines(&pulls(&items), [normal, line.along], &[link]);
            whole
        }
        None => d.rolling_pull(balance, (roll, link), &contact, size),
    };
    d.rolls_on(balance, roll, (link, pull), contact.at);
    let mut all = pulls(&items);
    all.push(pull);
    let of_guide = d.closing(&all);
    let mut about = items.clone();
    about.push(Item { pull: Some(pull), at: contact.at, couple: None });
    let couple = d.keeping(&about, at);
    let side = d.sliding_link(ride, link);
    d.note_slide(balance, ride, &side, first, SlideForce { pull: of_guide, at, couple });
}

/// A driven wheel, or a driven rack on one of that centre: the polygon gives how hard it presses and how it is held against slipping, or the force of the guide
/// of its centre; then moments give the effort.
pub(super) fn driven_wheel(
    d: &mut Draughtsman<'_>,
    (wheel, centre): (LinkId, PointId),
    (roll, guide): (usize, Option<usize>),
    input: Drive,
    balance: &mut Balance,
) {
    let contact = d.contact_at(roll);
    let at = d.at(centre);
    if let Some(guide) = guide
        && (Draughtsman::rubs_at(balance, centre) || (balance.leaning.leans(guide) && d.leans_by_teeth(roll)))
    {
        balance.refused = Some(TOOTHED);
        return;
    }
    let mut items = balance.on(wheel);
    let mut links = vec![wheel];
    match guide {
        None => {
            let [push, along] = d.two_lines(&pulls(&items), [contact.push, contact.tangent], &[wheel]);
            d.rolls_on(balance, roll, (wheel, along), contact.at);
            d.presses(balance, roll, (wheel, wheel), push, &contact);
            for pull in [push, along] {
                items.push(Item { pull: Some(pull), at: contact.at, couple: None });
            }
        }
        Some(guide) => {
            let sliding = d.sliding(guide, None);
            let on_block = balance.on_some(sliding.inner);
            let (_, normal) = d.pressing_at(balance, guide, at);
            let mut all = pulls(&items);
            all.extend(pulls(&on_block));
            let [_, along] = d.two_lines(&all, [normal, contact.tangent], &[wheel]);
            let parts = d.components_of(along);
            let size = d.part_along(parts, contact.tangent);
            let pull = d.rolling_pull(balance, (roll, wheel), &contact, size);
            d.rolls_on(balance, roll, (wheel, pull), contact.at);
            all.push(pull);
            let of_guide = d.closing(&all);
            let couple = d.keeping(&on_block, at);
            d.note_slide(balance, guide, &sliding, centre, SlideForce { pull: of_guide, at, couple });
            if let Some(block) = sliding.inner {
                let mut of_block = pulls(&on_block);
                of_block.push(of_guide);
                let on_block_at_pin = d.closing(&of_block);
                let on_wheel_at_pin = Draughtsman::opposite(on_block_at_pin);
                d.note_inner_pin(balance, centre, [(wheel, on_wheel_at_pin), (block, on_block_at_pin)]);
                links.push(block);
            }
            items.push(Item { pull: Some(pull), at: contact.at, couple: None });
        }
    }
    let moments = d.moments(&items, at);
    d.note_effort(balance, input, moments, (&links, centre));
}

/// A link about a pin, held by a contact: moments about the pin give how hard it presses.
pub(super) fn leaning(
    d: &mut Draughtsman<'_>,
    (link, base): (LinkId, PointId),
    wheel: LinkId,
    roll: usize,
    balance: &mut Balance,
) {
    let about = d.touch_at(balance, base, link);
    let items = balance.on(link);
    let (push, own) = pressing(d, (vec![link], link), (roll, wheel), (base, about), balance);
    let contact = d.contact_at(roll);
    d.presses(balance, roll, (own, link), push, &contact);
    let mut all = pulls(&items);
    all.push(push);
    let reaction = d.closing(&all);
    d.note_pin(balance, base, link, reaction);
}

/// How a contact presses on one of these links, which together turn about a base, by moments about it; and the body of the
/// pair that this link is, or that turns at its end.
pub(super) fn pressing(
    d: &mut Draughtsman<'_>,
    (mut links, link): (Vec<LinkId>, LinkId),
    (roll, wheel): (usize, LinkId),
    (base, about): (PointId, Point),
    balance: &mut Balance,
) -> (Pull, LinkId) {
    let items: Vec<Item> = links.iter().flat_map(|&body| balance.on(body)).collect();
    let contact = d.contact_at(roll);
    let [_, second] = d.mechanism.rolls[roll].bodies();
    let own = d.rolling_side(roll, link, wheel);
    let outward = if own == second { contact.push } else { d.board.reverse(contact.push) };
    let moments = d.moments(&items, about);
    let size = d.balancing(moments, Line { through: contact.at, along: outward }, about, &[link]);
    let found = TakenFor::Roll { roll, on: own, presses: true };
    if own != link {
        links.push(own);
    }
    balance.taken.push(Taken { links, about: About::Point(base), found });
    (d.pull_along(outward, size), own)
}

/// A link in a guide, held by a contact: a polygon with two known lines.
pub(super) fn riding_centre(
    d: &mut Draughtsman<'_>,
    (link, ride): (LinkId, usize),
    (wheel, centre): (LinkId, PointId),
    roll: usize,
    balance: &mut Balance,
) {
    let items = balance.on(link);
    let at = d.at(centre);
    let contact = d.contact_at(roll);
    let (_, normal) = d.pressing_at(balance, ride, at);
    let [push, of_guide] = d.two_lines(&pulls(&items), [contact.push, normal], &[link]);
    d.presses(balance, roll, (wheel, link), push, &contact);
    let mut about = items.clone();
    about.push(Item { pull: Some(push), at: contact.at, couple: None });
    let couple = d.keeping(&about, at);
    let side = d.sliding_link(ride, link);
    d.note_slide(balance, ride, &side, centre, SlideForce { pull: of_guide, at, couple });
}

impl Draughtsman<'_> {
    /// The body of a rolling pair that a link is, or that turns at its end.
    pub(super) fn rolling_side(&self, roll: usize, link: LinkId, wheel: LinkId) -> LinkId {
        if self.mechanism.rolls[roll].bodies().contains(&link) { link } else { wheel }
    }

    /// Notes an effort that balances moments about a point.
    pub(super) fn note_effort(
        &mut self,
        balance: &mut Balance,
        input: Drive,
        moments: Option<Amount>,
        (links, about): (&[LinkId], PointId),
    ) {
        let torque = match moments {
            Some(moments) => self.board.opposite(moments),
            None => self.rest(),
        };
        balance.note_effort(input, torque);
        if let Drive::Input(input) = input {
            let found = TakenFor::Effort(input);
            balance.taken.push(Taken { links: links.to_vec(), about: About::Point(about), found });
        }
    }
}

impl Balance {
    /// Whether contacts have to push in it: the parts of loads and of inertia alone are parts.
    fn judges(&self) -> bool {
        !matches!(self.share, Share::Static | Share::Inertia)
    }
}
