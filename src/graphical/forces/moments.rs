//! The moments that gave a size, with the arms as they are measured: a foot on the line of the force, and a reading.

use crate::board::{Line, Point};
use crate::mechanism::force::{Action, Force, Inertia, Party, Share, Sought, SpringKind, Through};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::{LinkId, Path, PointId, Rider};

use super::super::construction::About as Told;
use super::super::construction::{
    Acting, Arm, FreeBody, Knowledge, MassForces, MomentBalance, MomentTerm, Parts, Turning,
};
use super::super::draughtsman::Draughtsman;
use super::super::pose::Track;
use super::{About, Holder, Taken, TakenFor};

/// An arm shorter than this on paper is none: the line passes through the point, mm.
pub(super) const NO_ARM: f64 = 0.02;

/// Whether two actions are one force, or a force and its reaction.
pub(super) fn same_pair(one: Action, other: Action) -> bool {
    let key = |action: Action| match action {
        Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
        Action::OnPin(link, pin) => Action::OfPin(pin, link),
        Action::Spring { index, .. } => Action::Spring { index, end: 0 },
        Action::DriveBack(input) => Action::Drive(input),
        Action::Rolling { roll, .. } => Action::Rolling { roll, on: LinkId::FRAME },
        other => other,
    };
    key(one) == key(other)
}

/// A force at a pin, where it acts, and its parts across a line and along it.
struct Split {
    action: Action,
    at: Point,
    parts: [super::Pull; 2],
}

/// Moments with friction close to this part of the largest, which is what the last pass may leave.
const CLOSED: f64 = 1e-5;

impl Draughtsman<'_> {
    /// The force with which one link acts on another through a pin, as the one that does not hold the pin feels it.
    pub(super) fn force_at_pin(&self, pin: PointId, by: LinkId, on: LinkId) -> Action {
        if let Some(carrier) = self.carrier_of_whole(pin) {
            return if carrier == on { Action::OnPin(by, pin) } else { Action::OfPin(pin, on) };
        }
        if self.mechanism.parties_at(pin).len() < 3 {
            return Action::Pair { by, on };
        }
        if self.holder(pin) == Holder::Link(on) { Action::OnPin(by, pin) } else { Action::OfPin(pin, on) }
    }

    /// The link that carries the guide of a driven pin of which moments give what it passes on in all.
    pub(super) fn carrier_of_whole(&self, pin: PointId) -> Option<LinkId> {
        let (_, balance) = self.balances.iter().find(|(share, _)| *share == self.told)?;
        balance.whole_pins.iter().find(|(of, _)| *of == pin).map(|(_, carrier)| *carrier)
    }

    /// What acts on a body, that on the pin which it holds told apart.
    fn acting_on(&mut self, body: &FreeBody) -> Vec<Action> {
        let mut all = Vec::new();
        for action in body.acting.iter().map(|acting| acting.action) {
            match action {
                Action::OfPin(pin, link) if self.holder(pin) == Holder::Link(link) => {
                    let others = self.mechanism.parties_at(pin).into_iter().filter(|other| !body.has(*other));
                    all.extend(others.map(|other| Action::OnPin(other, pin)));
                }
                other => all.push(other),
            }
        }
        all
    }

    /// The moment of a force about a point, by its one arm; none where its line passes through the point. The force may
    /// be taken to another place.
    pub(super) fn moment_term(
        &mut self,
        action: Action,
        about: Point,
        moved: Option<Point>,
    ) -> Option<MomentTerm> {
        let items = self.items_of(action, self.told).ok()?;
        let pull = self.sum_of(&items);
        let point = self.couple_point(action);
        let rests = self.components_of(pull).map(|part| self.board.is_no_amount(part)) == [true; 2];
        if let (true, Some(point)) = (rests, point) {
            // A pair that passes on no force has a couple at most, whose moment is one about every point.
            let couple = self.pure_couple(&items);
            return (couple != 0.0).then(|| torque(Force::Moment(action, point), couple));
        }
        let foot = match moved {
            Some(at) => at,
            None => self.foot_of_line(&items)?,
        };
        self.term_of_pull(Turning::Force(action), pull, foot, about)
    }

    /// The point by which the couple of a pair is named that passes on no force: where it acts; none of what is no pair.
    fn couple_point(&self, action: Action) -> Option<PointId> {
        let m = self.mechanism;
        match action {
            Action::OfPin(pin, _) | Action::OnPin(_, pin) => Some(pin),
            Action::Pair { by, on } => match *m.pairs_between(by, on).first()? {
                Through::Pin(pin) => Some(pin),
                Through::Slide(slide) => m.pin_of_slide(slide),
                Through::Roll(roll) => m.contacts.get(roll).copied(),
            },
            _ => None,
        }
    }

    pub(super) fn term_of_pull(
        &mut self,
        of: Turning,
        pull: super::Pull,
        through: Point,
        about: Point,
    ) -> Option<MomentTerm> {
        let [x, y] = self.components_of(pull).map(|part| part.value());
        let size = libm::hypot(x, y);
        if size <= 0.0 {
            return None;
        }
        let reason = self.reason(&[]);
        let (along, _) = self.board.toward(pull.tail, pull.head, reason);
        let line = Line { through, along };
        let [beside, _] = self.board.square_off(line, about);
        let foot = self.board.step_off(through, along, beside);
        let arm = self.arm_of(line, about).value();
        let per_mm = self.length_scale().si_per_mm;
        if arm.abs() < NO_ARM * per_mm {
            return None;
        }
        let named = self.point_at(foot).zip(self.point_at(about));
        let foot = foot.value().map(|mm| mm * per_mm);
        let between = named.map(|(foot, about)| [about, foot]);
        let arm_drawn = Arm { length: arm.abs(), foot, between };
        Some(MomentTerm { of, size, arm: Some(arm_drawn), moment: size * arm })
    }

    /// The point of the mechanism that stands at a place.
    fn point_at(&self, place: Point) -> Option<PointId> {
        let [x, y] = place.value();
        let near = |at: &Point| {
            let [px, py] = at.value();
            libm::hypot(px - x, py - y) < NO_ARM
        };
        (0..self.places.len()).map(PointId).find(|p| self.places[p.0].as_ref().is_some_and(near))
    }

    /// The moments of a balance, as they are told at the bodies.
    pub(super) fn moments_told(&mut self, taken: &[Taken], bodies: &[FreeBody]) -> Vec<MomentBalance> {
        let mut all = Vec::new();
        for taken in taken {
            let Some(balance) = self.moment_balance(taken, bodies) else { continue };
            // A couple without a force is told with the lines of guides: which body leads to it hangs on all of them.
            let pure = |action: Action| Self::passes_a_couple(bodies, action);
            for term in &balance.terms {
                if !matches!(term.of, Turning::Torque(Force::Moment(action, _)) if pure(action)) {
                    all.extend(self.couple_told(term.of, balance.told, bodies));
                }
            }
            all.push(balance);
        }
        self.lines_in_guides(&mut all, bodies);
        self.name_couples(&mut all, bodies);
        all
    }

    /// Where a couple shifts what a straight guide exerts on its rider: the moments of a body on which no other such force
    /// is open tell it, of the rider about its joint or of the link that carries the guide about one of its own; each that is
    /// found may be what the next one needs. None of these is one of those that the balance has told.
    fn lines_in_guides(&mut self, told: &mut Vec<MomentBalance>, bodies: &[FreeBody]) {
        let is_told = |told: &[MomentBalance], pair: Action| {
            told.iter().any(|moments| match moments.found.of {
                Turning::Torque(Force::Moment(of, _)) => same_pair(of, pair),
                _ => false,
            })
        };
        let mut open: Vec<(PointId, Action)> = Vec::new();
        for slide in 0..self.mechanism.slides.len() {
            let guide = self.mechanism.slides[slide].guide;
            let (rider, pin) = match self.mechanism.slides[slide].rider {
                Rider::Pin { block: Some(block), point } => (block, point),
                Rider::Link { link, .. } => match self.mechanism.link(link).points.first() {
                    Some(first) => (link, *first),
                    None => continue,
                },
                Rider::Pin { block: None, .. } => continue,
            };
            let pair = Action::Pair { by: guide.link, on: rider };
            if !matches!(guide.path, Path::Straight { .. }) || is_told(told, pair) {
                continue;
            }
            let Ok(items) = self.items_of(pair, self.told) else { continue };
            let turned = |item: &super::Item| item.couple.is_some_and(|couple| couple.value() != 0.0);
            if items.iter().any(turned) {
                open.push((pin, pair));
            }
        }
        while let Some((pair, moments)) =
            (0..bodies.len()).find_map(|place| self.line_on_body(place, &open, told, bodies))
        {
            open.retain(|(_, other)| !same_pair(*other, pair));
            let later = |other: &MomentBalance| other.told > moments.told;
            let place = told.iter().position(later).unwrap_or(told.len());
            told.insert(place, moments);
        }
    }

    /// The moments of a body that tell the line of the one force of a guide on it whose line is open.
    fn line_on_body(
        &mut self,
        place: usize,
        open: &[(PointId, Action)],
        told: &[MomentBalance],
        bodies: &[FreeBody],
    ) -> Option<(Action, MomentBalance)> {
        let body = bodies.get(place)?;
        let Party::Link(link) = body.of else { return None };
        let on_body = |pair: Action| body.acting.iter().find(|acting| same_pair(acting.action, pair));
        let mut own = open.iter().filter_map(|(pin, pair)| Some((*pin, *pair, on_body(*pair)?.action)));
        let (Some((pin, pair, action)), None) = (own.next(), own.next()) else { return None };
        // What drives the body has to be found first.
        let is_found = |of: Turning| told.iter().any(|moments| moments.found.of == of);
        let driven =
            |(of, _): &(Force, f64)| matches!(of, Force::Torque(_)) && !is_found(Turning::Torque(*of));
        // The moments of one body give one number.
        let taken = told.iter().any(|moments| moments.links == body.links());
        if taken || body.torques.iter().any(driven) {
            return None;
        }
        let rides = matches!(pair, Action::Pair { on, .. } if on == link);
        let (_, balance) = self.balances.iter().find(|(share, _)| *share == self.told)?;
        if !rides && !balance.leaning.rubs().is_empty() {
            return None;
        }
        let hangs = |point: &PointId| body.acting.iter().any(|acting| self.passes(acting.action, *point));
        let about = match rides {
            true => pin,
            false => {
                let points = &self.mechanism.link(link).points;
                *points.iter().find(|point| hangs(point)).or(points.first())?
            }
        };
        let mut moments = self.moments_for_guide(body, action, (about, None))?;
        // What the body's own polygon gives is known with it, what other moments give after these.
        let needs = |moments: &MomentBalance, other: &MomentBalance| match other.found.of {
            Turning::Torque(Force::Moment(of, _)) => moments.terms.iter().any(|term| match term.of {
                Turning::Force(used) | Turning::Torque(Force::Moment(used, _)) => same_pair(used, of),
                _ => false,
            }),
            _ => false,
        };
        let before = told.iter().filter(|other| needs(&moments, other)).map(|other| other.told).max();
        moments.told = before.map_or(place, |before| before.max(place));
        // The moments of all else are what the guide has to take up, or something has none that could be told.
        let at = self.at(about);
        let items = self.items_of(action, self.told).ok()?;
        let whole = self.moments(&items, at)?.value();
        let largest = moments.terms.iter().map(|term| term.moment.abs()).fold(0.0, f64::max);
        ((whole - moments.found.moment).abs() <= CLOSED * largest).then_some((pair, moments))
    }

    /// Whether a force is none, but a couple.
    fn passes_a_couple(bodies: &[FreeBody], action: Action) -> bool {
        let mut all = bodies.iter().flat_map(|body| &body.acting);
        all.any(|acting| acting.couple != 0.0 && same_pair(acting.action, action))
    }

    /// The couple of a pair that passes on no force has one name, that by which it was found.
    fn name_couples(&self, told: &mut [MomentBalance], bodies: &[FreeBody]) {
        let pure = |action: Action| Self::passes_a_couple(bodies, action);
        let found: Vec<(Action, PointId)> = told
            .iter()
            .filter_map(|moments| match moments.found.of {
                Turning::Torque(Force::Moment(action, about)) if pure(action) => Some((action, about)),
                _ => None,
            })
            .collect();
        for term in told.iter_mut().flat_map(|moments| &mut moments.terms) {
            if let Turning::Torque(Force::Moment(action, about)) = &mut term.of
                && let Some((_, point)) = found.iter().find(|(other, _)| same_pair(*other, *action))
            {
                *about = *point;
            }
        }
    }

    /// The force of an arc on a block that something turns, or that of the block on the arc: along the line from the place
    /// where the pin acts on the block to the centre, and across it; with the centre, through which both pass.
    fn parts_on_arc(
        &mut self,
        balance: &super::Balance,
        (slide, action): (usize, Action),
        touch: Point,
    ) -> Option<([super::Pull; 2], Point)> {
        self.turned_on_arc(balance, slide)?;
        let Track::Arc(circle) = self.track(slide, None) else { return None };
        let items = self.items_of(action, self.told).ok()?;
        let whole = self.sum_of(&items);
        let reason = self.reason(&[]);
        let (along, _) = self.board.toward(touch, circle.centre, reason);
        let line = Line { through: whole.tail, along };
        let [size, _] = self.board.square_off(line, whole.head);
        let foot = self.board.step_off(whole.tail, along, size);
        let parts =
            [super::Pull { tail: whole.tail, head: foot }, super::Pull { tail: foot, head: whole.head }];
        Some((parts, circle.centre))
    }

    /// The moments of what rides in a guide about its pin, which give the couple that it exerts on the guide: they are told
    /// before those in which this couple stands.
    fn couple_told(&mut self, of: Turning, told: usize, bodies: &[FreeBody]) -> Option<MomentBalance> {
        let Turning::Torque(Force::Moment(Action::Pair { by: rider, on: guide }, pin)) = of else {
            return None;
        };
        let place = bodies.iter().position(|body| body.has(rider))?;
        let body = bodies.get(place)?;
        let pair = Action::Pair { by: guide, on: rider };
        let (_, balance) = self.balances.iter().find(|(share, _)| *share == self.told)?;
        let balance = balance.clone();
        // Where its pin rubs, its force acts at the point of contact.
        let touch = Self::rubs_at(&balance, pin).then(|| self.touch_at(&balance, pin, rider));
        let moments = self.moments_for_guide(body, pair, (pin, touch))?;
        Some(MomentBalance { links: vec![rider], told: told.min(place), ..moments })
    }

    /// The moments of a body about a point, or about the point of contact there, which give the moment of the force of a guide
    /// on it.
    fn moments_for_guide(
        &mut self,
        body: &FreeBody,
        pair: Action,
        (about, touch): (PointId, Option<Point>),
    ) -> Option<MomentBalance> {
        let at = touch.unwrap_or(self.at(about));
        let mut terms = Vec::new();
        for acting in &body.acting {
            if !same_pair(acting.action, pair) && !self.passes(acting.action, about) {
                let place = if acting.with_couple {
                    self.items_of(acting.action, self.told).ok()?.first().map(|item| item.at)
                } else {
                    None
                };
                terms.extend(self.moment_term(acting.action, at, place));
            }
        }
        terms.extend(body.torques.iter().map(|(force, value)| torque(*force, *value)));
        terms.retain(|term| term.moment != 0.0);
        let size: f64 = terms.iter().map(|term| term.moment).sum();
        let found = torque(Force::Moment(pair, about), -size);
        let per_mm = self.length_scale().si_per_mm;
        let about = match touch {
            Some(at) => Told::Contact { pin: about, at: at.value().map(|mm| mm * per_mm) },
            None => Told::Point(about),
        };
        let links = body.links();
        (size != 0.0).then(|| {
            self.with_shared_arms(MomentBalance { links, told: 0, about, terms, found, carried: None })
        })
    }

    pub(super) fn moment_balance(&mut self, taken: &Taken, bodies: &[FreeBody]) -> Option<MomentBalance> {
        let place = |link: LinkId| bodies.iter().position(|body| body.has(link));
        // A member of two forces gives only a line: the moments that give its force are told with it.
        let lends = match taken.found {
            TakenFor::Along { by, whole: true, .. } if self.has_two_forces(by) => Some(by),
            // At a pin of several links the first of them needs both parts of its force.
            TakenFor::Along { pin, by, on, .. } | TakenFor::Across { pin, by, on, .. }
                if self.is_of_several(pin) =>
            {
                [by, on].into_iter().find(|link| !taken.links.contains(link))
            }
            _ => None,
        };
        let told = taken.links.iter().copied().chain(lends).filter_map(place).min()?;
        let (_, balance) = self.balances.iter().find(|(share, _)| *share == self.told)?;
        let balance = balance.clone();
        let rubs = !balance.leaning.rubs().is_empty();
        // With friction a force acts where it touches the circle of its pin.
        let first = *taken.links.first()?;
        let (about, point) = match &taken.about {
            About::Point(point) => (self.touch_at(&balance, *point, first), Some(*point)),
            About::Meet { at, .. } => (*at, None),
        };
        let rubs_there = point.is_some_and(|pin| Self::rubs_at(&balance, pin));
        let mut terms: Vec<MomentTerm> = Vec::new();
        let mut found: Option<MomentTerm>;
        let mut nothing: Option<Turning> = None;
        let mut without: Vec<Action> = Vec::new();
        // What turns with its pin: what rides for a link acts on it there.
        let mut riders: Vec<(LinkId, Point)> = Vec::new();
        match taken.found {
            TakenFor::Effort(input) => {
                let effort = self.effort(Sought::Effort(input));
                found = effort.map(|effort| torque(Force::Torque(input), effort));
            }
            TakenFor::Driven(input) => {
                let action = Action::Drive(input);
                without.push(action);
                let at = self.at(self.mechanism.driven_point(input)?);
                found = self.moment_term(action, about, Some(at));
            }
            TakenFor::Across { pin, by, on, from } | TakenFor::Along { pin, by, on, from, .. } => {
                let split = self.split_at_pin(taken, (pin, [by, on], from), &balance)?;
                let Split { action, at, parts: [part_across, part_along] } = split;
                without.push(action);
                match taken.found {
                    TakenFor::Along { whole: all, .. } => {
                        if !all {
                            terms.extend(self.term_of_pull(Turning::Across(action), part_across, at, about));
                        }
                        let of = if all { Turning::Force(action) } else { Turning::Along(action) };
                        found = self.term_of_pull(of, part_along, at, about);
                    }
                    _ => {
                        found = self.term_of_pull(Turning::Across(action), part_across, at, about);
                        if let (Some(Arm { between, .. }), false) =
                            (found.as_mut().and_then(|f| f.arm.as_mut()), rubs)
                        {
                            *between = Some([from, pin]);
                        }
                    }
                }
            }
            TakenFor::Roll { roll, on, presses } => {
                let action = self.mechanism.force_of_roll(roll, on);
                without.push(action);
                let contact = self.contact_at(roll);
                if self.keeps_contact(roll) {
                    let items = self.items_of(action, self.told).ok()?;
                    let whole = self.sum_of(&items);
                    let line = Line { through: whole.tail, along: contact.push };
                    let [size, _] = self.board.square_off(line, whole.head);
                    let foot = self.board.step_off(whole.tail, contact.push, size);
                    let pressing = super::Pull { tail: whole.tail, head: foot };
                    let driving = super::Pull { tail: foot, head: whole.head };
                    let rests =
                        self.components_of(driving).map(|part| self.board.is_no_amount(part)) == [true; 2];
                    // Where nothing turns the wheel, nothing drives it.
                    nothing = (rests && !presses).then_some(Turning::Across(action));
                    let driving = self.term_of_pull(Turning::Across(action), driving, contact.at, about);
                    if presses {
                        terms.extend(driving);
                        found = self.term_of_pull(Turning::Along(action), pressing, contact.at, about);
                    } else {
                        found = driving;
                    }
                } else {
                    found = self.moment_term(action, about, Some(contact.at));
                }
            }
            TakenFor::Slide(slide) | TakenFor::Slot(slide) => {
                let pair = self.mechanism.slides[slide];
                let pin = self.mechanism.pin_of_slide(slide)?;
                let guide = pair.guide.link;
                // Of a driven lever with what is driven along it that body that has the pin.
                let parties = self.mechanism.parties_at(pin);
                let head = taken.links.iter().copied().find(|link| parties.contains(link)).unwrap_or(first);
                let at = match self.mechanism.party_of(&pair.rider) {
                    Party::Link(rider) if rubs => self.inner_touch(&balance, pin, [head, rider]),
                    _ => self.at(pin),
                };
                let on_guide = matches!(taken.found, TakenFor::Slot(_)) && taken.links.contains(&guide);
                let action = match self.mechanism.party_of(&pair.rider) {
                    Party::Link(link) if on_guide => Action::Pair { by: link, on: guide },
                    Party::Link(link) => Action::Pair { by: guide, on: link },
                    Party::Pin(pin) if on_guide => self.force_on_slot(pin, guide),
                    Party::Pin(pin) => self.force_of_guide(pin, guide, head),
                };
                without.push(action);
                let parts = self.parts_on_arc(&balance, (slide, action), at);
                if let Some(([part_along, part_across], centre)) = parts {
                    // Both parts pass through the centre of the arc.
                    terms.extend(self.term_of_pull(Turning::Across(action), part_across, centre, about));
                    found = self.term_of_pull(Turning::Along(action), part_along, centre, about);
                } else {
                    found = self.moment_term(action, about, Some(at));
                }
                // Where nothing turns the body, nothing presses on it.
                let rests = self.acting(action, Knowledge::Line).is_some_and(|own| own.acts_not());
                nothing = rests.then_some(Turning::Force(action));
                let straight = parts.is_none();
                if let (true, true, Party::Link(block)) =
                    (straight, on_guide, self.mechanism.party_of(&pair.rider))
                {
                    let items = self.items_of(action, self.told).ok()?;
                    let couple = match (Self::rubs_at(&balance, pin), balance.on(block).is_empty()) {
                        // Two forces on the block: that of its guide passes the point of contact.
                        (true, true) => None,
                        (true, false) => self.moments(&items, at),
                        (false, _) => items.iter().find_map(|item| item.couple),
                    };
                    let couple = couple.map(|couple| couple.value()).filter(|couple| *couple != 0.0);
                    terms.extend(couple.map(|couple| torque(Force::Moment(action, pin), couple)));
                }
                if let (true, TakenFor::Slide(_), Party::Link(block)) =
                    (straight, taken.found, self.mechanism.party_of(&pair.rider))
                {
                    riders.push((block, at));
                }
            }
            TakenFor::Arc(slide) => {
                let action = Action::Pair { by: self.mechanism.slides[slide].guide.link, on: first };
                without.push(action);
                let ([_, part_across], centre) = self.parts_on_arc(&balance, (slide, action), about)?;
                found = self.term_of_pull(Turning::Across(action), part_across, centre, about);
            }
        }
        // Without an effort it is what is sought on the driven link that its moments give.
        let sought = match taken.found {
            TakenFor::Effort(_) if found.is_none() => Some(self.sought_on(first)?),
            _ => None,
        };
        let mut carried = None;
        // Of links that are cut free together nothing that acts between them counts, and nothing twice.
        let together = |link: LinkId| bodies.iter().any(|body| body.with.contains(&link));
        let own = |body: &&FreeBody| body.links().iter().all(|link| taken.links.contains(link));
        for body in bodies.iter().filter(own) {
            let Party::Link(link) = body.of else { continue };
            if together(link) && body.with.is_empty() {
                continue;
            }
            let moved = riders.iter().find(|(block, _)| *block == link).map(|(_, at)| *at);
            let mut off_the_pin = false;
            let mut acting = self.acting_on(body);
            if let TakenFor::Driven(input) = taken.found
                && let Some(pin) = self.mechanism.driven_point(input)
                && let Some(place) = acting.iter().position(|action| *action == Action::OfPin(pin, link))
            {
                // What all others exert on the driven pin, but what drives it.
                acting.remove(place);
                let others = self.mechanism.parties_at(pin).into_iter().filter(|other| !body.has(*other));
                acting.extend(others.map(|other| Action::OnPin(other, pin)));
            }
            for action in acting {
                let within = |other: LinkId| !body.has(other) && taken.links.contains(&other);
                let inner = match action {
                    Action::Pair { by, .. } => within(by),
                    Action::Rolling { roll, on } => within(self.mechanism.bodies_rolling(roll, on)[0]),
                    Action::OnPin(other, _) => within(other),
                    Action::OfPin(pin, _) => taken
                        .links
                        .iter()
                        .any(|other| within(*other) && self.mechanism.parties_at(pin).contains(other)),
                    Action::Drive(input) | Action::DriveBack(input) => {
                        self.mechanism.driven_between(input).iter().all(|link| taken.links.contains(link))
                    }
                    _ => false,
                };
                // What a driven pin passes on in all stands for the force of its guide and what drives it.
                let told_whole = match action {
                    Action::OfPin(pin, _) | Action::OnPin(_, pin) => self.carrier_of_whole(pin).is_some(),
                    Action::Drive(input) | Action::DriveBack(input) => self
                        .mechanism
                        .driven_point(input)
                        .is_some_and(|pin| self.carrier_of_whole(pin).is_some()),
                    _ => false,
                };
                if inner || told_whole || without.iter().any(|other| same_pair(*other, action)) {
                    continue;
                }
                if point.is_some_and(|point| self.passes(action, point)) {
                    continue;
                }
                if let Some((pin, base, loaded)) = self.bar_of(action, &taken.about) {
                    // Its part along the bar passes through the meet.
                    if loaded {
                        terms.extend(self.across_of(action, (base, pin), about));
                    }
                    continue;
                }
                let shifted = body.acting.iter().any(|a| a.action == action && a.with_couple);
                let place = if shifted {
                    self.items_of(action, self.told).ok().and_then(|i| i.first().map(|i| i.at))
                } else {
                    moved
                };
                if let Some(at) = moved {
                    off_the_pin |= !shifted && self.moment_term(action, at, None).is_some();
                }
                terms.extend(self.moment_term(action, about, place));
            }
            if moved.is_some() && (off_the_pin || !body.torques.is_empty()) {
                carried = self.rider_pin(taken).map(|pin| (link, pin));
            }
            if moved.is_none() {
                let given = body.torques.iter().filter(|(force, _)| !matches!(force, Force::Torque(_)));
                terms.extend(given.map(|(force, value)| torque(*force, *value)));
            }
        }
        // On the link that carries the guide acts what all the others pass on at the pin.
        if let TakenFor::Across { pin, by, .. } | TakenFor::Along { pin, by, .. } = taken.found
            && let Some(carrier) = self.carrier_of_whole(pin).filter(|carrier| taken.links.contains(carrier))
        {
            let at = self.at(pin);
            let others =
                self.mechanism.parties_at(pin).into_iter().filter(|other| ![by, carrier].contains(other));
            for other in others {
                terms.extend(self.moment_term(Action::OnPin(other, pin), about, Some(at)));
            }
        }
        terms.retain(|term| term.moment != 0.0);
        if let Some(sought) = sought {
            let place = terms.iter().position(|term| match (term.of, sought) {
                (Turning::Force(of), Turning::Force(sought)) => same_pair(of, sought),
                (of, sought) => of == sought,
            });
            found = place.map(|place| terms.remove(place));
        }
        let none = |of| MomentTerm { of, size: 0.0, arm: None, moment: 0.0 };
        let found = found.or(nothing.filter(|_| terms.is_empty()).map(none))?;
        // What does not add up to nothing is no balance to be told.
        let sum = terms.iter().chain([&found]).map(|term| term.moment).sum::<f64>();
        let largest = terms.iter().chain([&found]).map(|term| term.moment.abs()).fold(0.0, f64::max);
        // Forces that pass the point within what can be measured have no arm.
        let own = bodies.iter().filter(own).flat_map(|body| &body.acting);
        let forces: f64 = own.map(|acting| libm::hypot(acting.force[0], acting.force[1])).sum();
        let unmeasured = if rubs { 0.0 } else { NO_ARM * self.length_scale().si_per_mm * forces };
        if sum.abs() > CLOSED * largest + unmeasured {
            return None;
        }
        let about = match &taken.about {
            About::Point(point) if rubs_there => {
                let per_mm = self.length_scale().si_per_mm;
                Told::Contact { pin: *point, at: about.value().map(|mm| mm * per_mm) }
            }
            About::Point(point) => Told::Point(*point),
            About::Meet { of, at, .. } => {
                let per_mm = self.length_scale().si_per_mm;
                let on = *taken.links.first()?;
                Told::Meet { on, of: *of, at: at.value().map(|mm| mm * per_mm) }
            }
        };
        Some(self.with_shared_arms(MomentBalance {
            links: taken.links.clone(),
            told,
            about,
            terms,
            found,
            carried,
        }))
    }

    /// The force between two links at a pin, and its parts across the line from another pin and along it.
    fn split_at_pin(
        &mut self,
        taken: &Taken,
        (pin, [by, on], from): (PointId, [LinkId; 2], PointId),
        balance: &super::Balance,
    ) -> Option<Split> {
        let action = self.force_at_pin(pin, by, on);
        let items = self.items_of(action, self.told).ok()?;
        let whole = self.sum_of(&items);
        let at = self.inner_touch(balance, pin, [by, on]);
        let other = if taken.links.contains(&by) { on } else { by };
        let based = match taken.found {
            TakenFor::Across { .. } => *taken.links.first()?,
            // Of a driven lever it is the lever that turns about the base.
            _ => {
                let members = balance.members.iter().map(|(links, _)| links).find(|l| l.contains(&other));
                members.and_then(|links| links.first().copied()).unwrap_or(other)
            }
        };
        let base = self.touch_at(balance, from, based);
        let reason = self.reason(&[by, on]);
        let (along, _) = self.board.toward(base, at, reason);
        let line = Line { through: whole.tail, along };
        let [size, _] = self.board.square_off(line, whole.head);
        let foot = self.board.step_off(whole.tail, along, size);
        let along = super::Pull { tail: whole.tail, head: foot };
        let across = super::Pull { tail: foot, head: whole.head };
        Some(Split { action, at, parts: [across, along] })
    }

    /// Notes at the bodies of which forces moments have given a part, and what the parts are.
    pub(super) fn parts_told(
        &mut self,
        balance: &super::Balance,
        taken: &[Taken],
        moments: &[MomentBalance],
        bodies: &mut [FreeBody],
    ) {
        for taken in taken {
            let TakenFor::Across { pin, by, on, from } = taken.found else { continue };
            let Some(split) = self.split_at_pin(taken, (pin, [by, on], from), balance) else { continue };
            if !moments.iter().any(|moments| moments.found.of == Turning::Across(split.action)) {
                continue;
            }
            let touches = [pin, from].iter().any(|pin| Self::rubs_at(balance, *pin));
            let [across, along] = split.parts.map(|part| self.components_of(part).map(|part| part.value()));
            let all = bodies.iter_mut().flat_map(|body| &mut body.acting);
            let open = all.filter(|acting| acting.known != Knowledge::Full);
            for acting in open.filter(|acting| same_pair(acting.action, split.action)) {
                let [x, y] = [0, 1].map(|axis| across[axis] + along[axis]);
                // Of the reaction both are turned round.
                let sign = if x * acting.force[0] + y * acting.force[1] < 0.0 { -1.0 } else { 1.0 };
                let [across, along] = [across, along].map(|part| part.map(|part| sign * part));
                acting.parts = Some(Parts { across, along, line: [from, pin], touches });
            }
        }
    }

    /// Whether several links meet at a pin, each of which is in balance before the pin is, and the last one after it.
    pub(super) fn is_of_several(&self, pin: PointId) -> bool {
        let parties = self.mechanism.parties_at(pin);
        parties.len() > 2
            && !parties.contains(&LinkId::FRAME)
            && self.mechanism.drive_of_pin(pin).is_none()
            && self.carrier_of_whole(pin).is_none()
    }

    /// The pin of what rides in the guide whose force these moments give.
    fn rider_pin(&self, taken: &Taken) -> Option<PointId> {
        match taken.found {
            TakenFor::Slide(slide) => self.mechanism.pin_of_slide(slide),
            _ => None,
        }
    }

    /// Forces on one line have one arm.
    pub(super) fn with_shared_arms(&self, mut moments: MomentBalance) -> MomentBalance {
        let per_mm = self.length_scale().si_per_mm;
        let mut arms: Vec<Arm> = Vec::new();
        for term in moments.terms.iter_mut().chain([&mut moments.found]) {
            let Some(arm) = term.arm else { continue };
            let same = |other: &&Arm| {
                let off = libm::hypot(other.foot[0] - arm.foot[0], other.foot[1] - arm.foot[1]);
                off < NO_ARM * per_mm && other.between == arm.between
            };
            match arms.iter().find(same) {
                Some(other) => term.arm = Some(*other),
                None => arms.push(arm),
            }
        }
        moments
    }

    /// The one load or spring that is sought, where it is a force or a torque on this link and on no other that moves.
    pub(super) fn sought_on(&self, link: LinkId) -> Option<Turning> {
        let forces = &self.mechanism.forces;
        match self.mechanism.named_sought()[..] {
            [Sought::Load(index)] => {
                let load = &forces.loads[index];
                let of = match load.is_torque() {
                    true => Turning::Torque(Force::LoadTorque(index)),
                    false => Turning::Force(Action::Load(index)),
                };
                (load.link == link).then_some(of)
            }
            [Sought::Spring(index)] => match forces.springs[index].kind {
                SpringKind::Pull(ends) => {
                    let end = ends.iter().position(|(of, _)| *of == link)?;
                    let of = Turning::Force(Action::Spring { index, end });
                    (ends[1 - end].0 == LinkId::FRAME).then_some(of)
                }
                SpringKind::Torsion(_) => None,
            },
            _ => None,
        }
    }

    /// Arms and moments that somebody asks for and no balance has: the arm of each, about its point.
    pub(super) fn arms_asked(&mut self, told: &[MomentBalance]) -> Vec<MomentBalance> {
        let asked: Vec<Force> = self
            .mechanism
            .asked
            .iter()
            .filter_map(|asked| match asked.quantity {
                Quantity::Force(force @ (Force::Arm(..) | Force::Moment(..)), Share::Total) => Some(force),
                _ => None,
            })
            .collect();
        let mut all: Vec<MomentBalance> = Vec::new();
        for force in asked {
            let (Force::Arm(action, pin) | Force::Moment(action, pin)) = force else { continue };
            let at = self.at(pin);
            if let Some(own) = self.acting(action, Knowledge::Full).filter(|own| own.couple != 0.0) {
                // A couple has no arm.
                let found = MomentTerm { of: Turning::Torque(force), ..torque(force, own.couple) };
                let (links, about, terms) = (Vec::new(), Told::Point(pin), Vec::new());
                all.push(MomentBalance { links, told: 1, about, terms, found, carried: None });
                continue;
            }
            let Some(term) = self.moment_term(action, at, None) else {
                // What has a size and no arm passes through the point.
                if let Some(own) = self.acting(action, Knowledge::Full)
                    && own.force != [0.0; 2]
                {
                    let size = libm::hypot(own.force[0], own.force[1]);
                    let found = MomentTerm { of: Turning::Torque(force), size, arm: None, moment: 0.0 };
                    let about = Told::Point(pin);
                    all.push(MomentBalance {
                        links: Vec::new(),
                        told: 1,
                        about,
                        terms: Vec::new(),
                        found,
                        carried: None,
                    });
                }
                continue;
            };
            let same = |term: &MomentTerm| matches!(term.of, Turning::Force(of) if same_pair(of, action));
            let mut terms = told.iter().filter(|moments| moments.about == Told::Point(pin));
            let known = terms.find_map(|moments| {
                moments.terms.iter().chain([&moments.found]).find(|term| same(term)).and_then(|term| term.arm)
            });
            // With a couple beside it the force of a pair has another line than through its pin.
            let of_pair = matches!(action, Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..));
            let coupled = self.items_of(action, self.told).is_ok_and(|items| {
                items.iter().filter_map(|item| item.couple).any(|couple| couple.value() != 0.0)
            });
            let known = known.filter(|_| !(of_pair && coupled));
            let of_inertia = matches!(action, Action::Inertia(link)
                if self.mechanism.forces.mass(link).is_some_and(|mass| mass.centre == pin));
            let touches = self.mechanism.forces.friction.circle(pin).is_some();
            let at_pin = match action {
                Action::Pair { .. } => self.passes(action, pin),
                Action::OfPin(of, _) | Action::OnPin(_, of) => of == pin,
                _ => false,
            };
            if of_inertia || (touches && at_pin) {
                continue;
            }
            let term = MomentTerm { arm: known.or(term.arm), of: Turning::Torque(force), ..term };
            all.push(MomentBalance {
                links: Vec::new(),
                told: usize::from(known.is_some()),
                about: Told::Point(pin),
                terms: vec![MomentTerm { of: Turning::Force(action), ..term }],
                found: term,
                carried: None,
            });
        }
        all
    }

    /// The bar that acts so on a link about whose legs' meet moments are taken: its pin there, its other pin, and whether
    /// something acts on it besides.
    fn bar_of(&self, action: Action, about: &About) -> Option<(PointId, PointId, bool)> {
        let About::Meet { bars, .. } = about else { return None };
        let Action::Pair { by, .. } = action else { return None };
        bars.iter().find(|(_, bar, ..)| *bar == by).map(|(pin, _, base, loaded)| (*pin, *base, *loaded))
    }

    /// The moment of the part of a force at a pin that is across the line from another pin.
    fn across_of(
        &mut self,
        action: Action,
        (from, pin): (PointId, PointId),
        about: Point,
    ) -> Option<MomentTerm> {
        let items = self.items_of(action, self.told).ok()?;
        let whole = self.sum_of(&items);
        let (at, base) = (self.at(pin), self.at(from));
        let reason = self.reason(&[]);
        let (along, _) = self.board.toward(base, at, reason);
        let [size, _] = self.board.square_off(Line { through: whole.tail, along }, whole.head);
        let foot = self.board.step_off(whole.tail, along, size);
        let part = super::Pull { tail: foot, head: whole.head };
        self.term_of_pull(Turning::Across(action), part, at, about)
    }

    /// Whether a force passes through a point by its pair.
    fn passes(&self, action: Action, about: PointId) -> bool {
        match action {
            Action::OfPin(pin, _) | Action::OnPin(_, pin) => pin == about,
            Action::Pair { by, on } => {
                let pairs = self.mechanism.pairs_between(by, on);
                matches!(pairs[..], [Through::Pin(pin)] if pin == about)
            }
            _ => false,
        }
    }

    /// The force of a pin on a link in whose slot it rides.
    fn force_on_slot(&self, pin: PointId, slot: LinkId) -> Action {
        let parties = self.mechanism.parties_at(pin);
        match parties[..] {
            [one, other] => Action::Pair { by: if one == slot { other } else { one }, on: slot },
            _ => Action::OfPin(pin, slot),
        }
    }

    /// The force of a guide on a pin that rides in it, as a link of the pin feels it.
    fn force_of_guide(&self, pin: PointId, guide: LinkId, link: LinkId) -> Action {
        match self.mechanism.parties_at(pin).len() {
            0..=2 => Action::Pair { by: guide, on: link },
            _ => Action::OnPin(guide, pin),
        }
    }

    fn effort(&mut self, sought: Sought) -> Option<f64> {
        let (_, balance) = self.balances.iter().find(|(share, _)| *share == self.told)?;
        balance.efforts.iter().find(|(of, _)| *of == sought).map(|(_, size)| size.value())
    }

    /// The line of the shaking force: its moment about the first fixed pivot is that of all inertia forces.
    pub(super) fn shaking_told(&mut self, inertia: &[Acting]) -> Option<MomentBalance> {
        let about = (0..self.mechanism.points.len()).map(PointId).find(|p| self.mechanism.is_fixed(*p))?;
        let at = self.at(about);
        let found = self.moment_term(Action::Shaking, at, None)?;
        let mut terms = Vec::new();
        let masses = self.mechanism.forces.masses.clone();
        for mass in masses {
            let action = Action::Inertia(mass.link);
            let drawn = inertia.iter().find(|acting| acting.action == action);
            let shifted = drawn.is_some_and(|acting| acting.with_couple);
            let place = shifted.then(|| self.at(mass.centre));
            terms.extend(self.moment_term(action, at, place));
            if (shifted || drawn.is_none())
                && let Some(couple) = self.inertia_torque(&mass)
            {
                terms.push(torque(Force::InertiaTorque(mass.link), couple.value()));
            }
        }
        terms.retain(|term| term.moment != 0.0);
        Some(MomentBalance {
            links: Vec::new(),
            told: 0,
            about: Told::Point(about),
            terms,
            found,
            carried: None,
        })
    }

    /// The line of what the frame feels: its moment about the first fixed pivot is that of all pairs.
    pub(super) fn frame_line_told(&mut self, pairs: &[Acting]) -> Option<MomentBalance> {
        let about = (0..self.mechanism.points.len()).map(PointId).find(|p| self.mechanism.is_fixed(*p))?;
        let at = self.at(about);
        let found = self.moment_term(Action::OnFrame, at, None)?;
        let terms = pairs.iter().filter_map(|acting| self.moment_term(acting.action, at, None));
        let mut terms: Vec<MomentTerm> = terms.collect();
        terms.retain(|term| term.moment != 0.0);
        let balance = MomentBalance {
            links: Vec::new(),
            told: 0,
            about: Told::Point(about),
            terms,
            found,
            carried: None,
        };
        let sum: f64 = balance.terms.iter().map(|term| term.moment).sum();
        let largest = balance.terms.iter().map(|term| term.moment.abs()).fold(found.moment.abs(), f64::max);
        ((sum - found.moment).abs() <= CLOSED * largest).then(|| self.with_shared_arms(balance))
    }

    /// What inertia and weight each mass has.
    pub(super) fn masses_told(&mut self, drawn: impl Fn(LinkId) -> bool) -> Vec<MassForces> {
        let masses = self.mechanism.forces.masses.clone();
        let mut all = Vec::new();
        for mass in masses.iter().filter(|mass| drawn(mass.link)) {
            let kilograms = self.kilograms(mass).map(|m| m.value());
            let inertia = match mass.inertia {
                Inertia::Point => None,
                _ => self.central_inertia(mass).map(|i| i.value()),
            };
            let weight = self.weight(mass).map(|pull| {
                let [x, y] = self.components_of(pull).map(|part| part.value());
                libm::hypot(x, y)
            });
            let acceleration = if self.mechanism.is_fixed(mass.centre) {
                0.0
            } else {
                let image = self.image(Order::Acceleration, mass.centre);
                let pole = self.board.origin();
                let mm = self.board.distance(pole, image);
                let scale = self.polygon_scale(Order::Acceleration);
                // What its own error does not tell from zero is none.
                if self.board.is_nothing(mm) { 0.0 } else { self.board.read(mm, scale).value() }
            };
            let turns = !self.translates[mass.link.0];
            let alpha = turns.then(|| {
                let rate = self.rate(Order::Acceleration, mass.link);
                if self.board.is_no_amount(rate) { 0.0 } else { rate.value() }
            });
            let (link, centre) = (mass.link, mass.centre);
            all.push(MassForces { link, centre, mass: kilograms, inertia, weight, acceleration, alpha });
        }
        all
    }
}

fn torque(of: Force, value: f64) -> MomentTerm {
    MomentTerm { of: Turning::Torque(of), size: value.abs(), arm: None, moment: value }
}
