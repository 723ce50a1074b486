//! What the balance leaves on the paper: the free bodies in the order of solution, and the whole.

use crate::mechanism::force::{
    Action, Force, Load, LoadKind, Party, Pointing, Share, Sought, Spring, SpringKind, SpringLaw,
};
use crate::mechanism::friction::{Rub, RubbingPair};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::structure::Closing;
use crate::mechanism::{Input, LinkId, PointId};
use crate::plan::Plan;

use super::super::construction::About as Told;
use super::super::construction::{
    Acting, ForceSheet, FreeBody, Knowledge, LoadSize, MeetOfThree, Member, MomentBalance, SpringTwist,
    Stiffness, Touch, Turning,
};
use super::super::draughtsman::Draughtsman;
use super::moments::same_pair;
use super::{About, Balance, Item, Taken, TakenFor, ThreeForces};

/// A line of inertia farther off than this part of the skeleton's size has no room on the paper.
const REACH: f64 = 0.6;

/// The free bodies of a plan, with everything that acts on them.
pub(in super::super) fn record(d: &mut Draughtsman<'_>, plan: &Plan) -> Option<ForceSheet> {
    if d.acts_without_direction() {
        return None;
    }
    if d.mechanism.forces.spin.is_some()
        && let Some(sheet) = super::governor::record(d, plan)
    {
        return Some(sheet);
    }
    let share = told_share(d)?;
    d.told = share;
    let sheet = of_share(d, plan, share);
    d.told = Share::Total;
    sheet
}

/// What is told beside the numbers where nothing is drawn of forces: what rubs, and stiffnesses. Of free bodies and their
/// bounds there is none.
pub(in super::super) fn record_numbers(d: &mut Draughtsman<'_>, plan: &Plan) -> Option<ForceSheet> {
    if d.acts_without_direction() {
        return None;
    }
    if d.mechanism.forces.spin.is_some() {
        return record(d, plan);
    }
    let share = told_share(d)?;
    let balance = d.balances.iter().find(|(of, _)| *of == share).map(|(_, balance)| balance.clone())?;
    d.told = share;
    let passes = balance.leaning.passes();
    let rubs = balance.leaning.rubs().to_vec().into_iter().filter_map(|rub| d.touching(rub)).collect();
    let stiffnesses = d.stiffnesses_told(share);
    d.told = Share::Total;
    Some(ForceSheet { share, rubs, passes, stiffnesses, ..ForceSheet::default() })
}

/// Which part of the forces is told.
fn told_share(d: &Draughtsman<'_>) -> Option<Share> {
    // With a drag a governor that rests is in balance while its sleeve is about to move.
    let told = |share: &Share| {
        let balanced = |balance: &Balance| balance.refused.is_none() && !balance.unbalanced;
        d.balances.iter().any(|(of, found)| of == share && balanced(found))
    };
    [Share::Total, Share::Rising, Share::Falling].into_iter().find(told)
}

/// The free bodies of one part of what acts.
fn of_share(d: &mut Draughtsman<'_>, plan: &Plan, share: Share) -> Option<ForceSheet> {
    let balance = d.balances.iter().find(|(of, _)| *of == share).map(|(_, balance)| balance.clone())?;
    let three = balance.meets.clone();
    let (rubs, passes) = (balance.leaning.rubs().to_vec(), balance.leaning.passes());
    let (as_one, members) = (balance.as_one.clone(), balance.members.clone());
    let (trial, trials, mut group_trials) =
        (balance.trial, balance.trials.clone(), balance.group_trials.clone());
    // Of a governor that is not told by its sleeve and its arm no moments are told.
    let told = |_: &&Taken| d.mechanism.forces.spin.is_none();
    let taken: Vec<Taken> = balance.taken.iter().filter(told).cloned().collect();
    let rubs = rubs.into_iter().filter_map(|rub| d.touching(rub)).collect();
    let mut bodies = Vec::new();
    // What moments of the driven link give needs no trial.
    let by_driven = |taken: &Taken| {
        let first = taken.links.first().copied();
        matches!(taken.found, TakenFor::Effort(_)) && first.is_some_and(|link| d.sought_on(link).is_some())
    };
    let tried = (trial.is_some() || trials.is_some()) && !taken.iter().any(by_driven);
    let mut found = Found { members: members.clone(), tried, ..Found::default() };
    for &group in plan.forces.groups.iter().rev() {
        let mut links = d.structure.groups[group].links.clone();
        let joined: Vec<Vec<LinkId>> =
            as_one.iter().filter(|all| all.iter().all(|link| links.contains(link))).cloned().collect();
        // What is handed on to another body is balanced after it, on its own.
        let after: Vec<LinkId> = joined.iter().flat_map(|all| all[1..].iter().copied()).collect();
        links.retain(|link| !after.contains(link));
        let own: Vec<&Taken> =
            taken.iter().filter(|taken| taken.links.iter().any(|link| links.contains(link))).collect();
        let tried = group_trials.iter().find(|trial| trial.links.iter().any(|link| links.contains(link)));
        let chunks = match tried {
            // One after the other, once what is left open is found.
            Some(trial) => {
                let one_by_one = trial.links.iter().map(|link| vec![*link]).collect();
                let open: Vec<Closing> = trial.found.iter().map(|(_, closing, _)| *closing).collect();
                d.reordered(one_by_one, &own, &open, (&joined, &found))
            }
            // The route that was asked for has its own order.
            None if three.iter().any(|meet| links.contains(&meet.link)) => {
                let mut all = in_order(&links, &own);
                // The other one gives the line of the second force.
                all.sort_by_key(|chunk| three.iter().any(|meet| chunk.contains(&meet.link)));
                all.into_iter().map(Chunk::of).collect()
            }
            None => {
                let mut all = in_order(&links, &own);
                if let Some(order) = d.one_by_one(&own, &all) {
                    all = order;
                }
                all.extend(after.iter().map(|link| vec![*link]));
                d.reordered(all, &own, &[], (&joined, &found))
            }
        };
        for Chunk { links: chunk, gives } in chunks {
            found.by_moments = own.iter().filter_map(|taken| d.given_by_moments(taken)).collect();
            let mut parties: Vec<Party> = Vec::new();
            for link in &chunk {
                parties.extend(d.pins_before(*link, &bodies).into_iter().map(Party::Pin));
                parties.push(Party::Link(*link));
            }
            // The polygon of a driven pin gives what its links need, that of another one what they need together.
            let pins = d.pins_among(&chunk, gives, &bodies);
            let gives = gives || !pins.is_empty();
            parties.extend(pins.into_iter().map(Party::Pin));
            let first = bodies.len();
            for (place, party) in parties.iter().enumerate() {
                let body = match *party {
                    Party::Link(link) => d.free_bodies(link, &joined, &found),
                    Party::Pin(pin) => d.free_pin(pin, &found),
                };
                bodies.extend(body.map(|body| FreeBody {
                    with_next: (chunk.len() > 1 || gives) && place + 1 < parties.len(),
                    ..body
                }));
                if chunk.len() == 1 && !gives {
                    found.learn(&bodies[first..]);
                }
            }
            let meets = own.iter().any(|taken| matches!(taken.about, About::Meet { .. }));
            let by_rods = held_by_rods(&own).is_some() && chunk.len() > 1;
            if meets || by_rods || gives {
                closed_by_the_last(&mut bodies[first..]);
            }
            found.learn(&bodies[first..]);
        }
    }
    let everything = d.mechanism.moving().all(|link| plan.forces.links.contains(&link));
    let whole = if everything { d.outer_forces() } else { Vec::new() };
    let inertia = match everything && !d.mechanism.forces.masses.is_empty() {
        true => {
            let masses = d.mechanism.forces.masses.clone();
            masses.iter().filter_map(|mass| d.acting(Action::Inertia(mass.link), Knowledge::Full)).collect()
        }
        false => Vec::new(),
    };
    if bodies.is_empty() {
        return None;
    }
    let moments = d.moments_told(&taken, &bodies);
    // What moments of the driven link give needs no trial.
    let forces = d.mechanism.forces.clone();
    let by_moments = |moments: &MomentBalance| match moments.found.of {
        Turning::Force(Action::Load(index)) | Turning::Torque(Force::LoadTorque(index)) => {
            forces.loads[index].is_sought()
        }
        Turning::Force(Action::Spring { index, .. }) => forces.springs[index].is_sought(),
        _ => false,
    };
    let trial = trial.filter(|_| !moments.iter().any(by_moments));
    let meets = three.iter().filter_map(|meet| d.meet_told(meet, &mut bodies)).collect();
    d.parts_told(&balance, &taken, &moments, &mut bodies);
    let members = members.into_iter().filter_map(|member| d.member_told(member, &bodies)).collect();
    let shaking = if inertia.is_empty() { None } else { d.shaking_told(&inertia) };
    let frame = if everything && d.asks_for(Action::OnFrame) { d.on_frame_told() } else { Vec::new() };
    let frame_line = if frame.is_empty() { None } else { d.frame_line_told(&frame) };
    let told: Vec<MomentBalance> = moments.iter().chain(&shaking).chain(&frame_line).cloned().collect();
    let arms = d.arms_asked(&told);
    // A governor rests in its own plane.
    let governs = d.mechanism.forces.spin.is_some();
    let masses = d.masses_told(|link| !governs && plan.forces.links.contains(&link));
    group_trials.retain_mut(|trial| {
        let of_group = |body: &FreeBody| matches!(body.of, Party::Link(l) if trial.links.contains(&l));
        let Some(told) = bodies.iter().position(of_group) else { return false };
        trial.told = told;
        true
    });
    let contacts = (0..d.mechanism.rolls.len()).filter(|roll| d.keeps_contact(*roll)).collect();
    let drawn = |link: LinkId| plan.forces.links.contains(&link);
    let (sizes, twists) = (d.sizes_told(drawn), d.twists_told(drawn));
    let stiffnesses = d.stiffnesses_told(share);
    Some(ForceSheet {
        share,
        governor: None,
        masses,
        bodies,
        moments,
        arms,
        meets,
        members,
        whole,
        inertia,
        shaking,
        asks_shaking: d.asks_for(Action::Shaking),
        frame,
        frame_line,
        trial,
        group_trials,
        contacts,
        trials,
        rubs,
        passes,
        sizes,
        twists,
        stiffnesses,
    })
}

/// Bodies of a group that are told together.
struct Chunk {
    links: Vec<LinkId>,
    /// The polygon of the last one gives what those of the others need.
    gives: bool,
}

impl Chunk {
    const fn of(links: Vec<LinkId>) -> Self {
        Self { links, gives: false }
    }
}

/// The forces that earlier bodies have given, and those that moments give before a polygon is laid off.
#[derive(Debug, Default)]
pub(super) struct Found {
    known: Vec<Action>,
    by_moments: Vec<Action>,
    /// Links that have two forces together.
    members: Vec<(Vec<LinkId>, [PointId; 2])>,
    /// What is sought elsewhere than at an input was found by trials.
    tried: bool,
}

impl Found {
    /// What moments give, before any body is in balance.
    pub(super) const fn of_moments(by_moments: Vec<Action>) -> Self {
        Self { known: Vec::new(), by_moments, members: Vec::new(), tried: false }
    }

    pub(super) fn learn(&mut self, bodies: &[FreeBody]) {
        // A body of two forces of which none is found gives only their line.
        let open = |acting: &Acting| acting.closes && acting.force != [0.0; 2];
        let gives = |body: &&FreeBody| body.acting.len() != 2 || !body.acting.iter().all(open);
        let all = bodies.iter().filter(gives).flat_map(|body| &body.acting);
        self.known.extend(all.map(|acting| acting.action));
    }

    fn is_known(&self, action: Action) -> bool {
        self.known.iter().any(|known| same_pair(*known, action))
    }

    /// Whether a force is one of the two that act on several links together, so that its line is that of their ends.
    fn is_of_member(&self, link: LinkId, other: LinkId) -> bool {
        self.members.iter().any(|(links, _)| links.contains(&link) != links.contains(&other))
    }
}

/// The links of a group in the order in which they are balanced; those that are balanced together stand together.
fn in_order(links: &[LinkId], taken: &[&Taken]) -> Vec<Vec<LinkId>> {
    // What a block on an arc needs of it is told with the block, wherever that stands.
    let taken: Vec<&Taken> =
        taken.iter().copied().filter(|taken| !matches!(taken.found, TakenFor::Arc(_))).collect();
    let taken = &taken[..];
    let mut all: Vec<LinkId> = links.iter().rev().copied().collect();
    let first = |taken: &Taken| taken.links.first().copied();
    // The legs whose moments give a part of their force, the link that they hold, and the others.
    if let Some(middle) = taken.iter().find(|taken| matches!(taken.about, About::Meet { .. })) {
        let across = |link: &LinkId| {
            taken.iter().any(|of| matches!(of.found, TakenFor::Across { .. }) && of.links.contains(link))
        };
        all.sort_by_key(|link| Some(*link) == first(middle));
        all.sort_by_key(|link| (middle.links.contains(link), !across(link)));
        return vec![all];
    }
    if let Some(bar) = held_by_rods(taken) {
        let across = |link: &LinkId| taken.iter().any(|of| of.links.contains(link));
        all.sort_by_key(|link| (*link == bar, !across(link)));
        return vec![all];
    }
    match taken {
        [one, other] if matches!(one.found, TakenFor::Across { .. }) => {
            let together: Vec<LinkId> = [*one, *other].into_iter().filter_map(first).collect();
            all.retain(|link| !together.contains(link));
            return std::iter::once(together).chain(all.into_iter().map(|link| vec![link])).collect();
        }
        // The member of two forces first: it gives the line.
        [one] if matches!(one.found, TakenFor::Along { .. }) => {
            all.sort_by_key(|link| Some(*link) == first(one));
        }
        [one] if matches!(one.found, TakenFor::Slot(_)) => {
            all.sort_by_key(|link| Some(*link) != first(one));
        }
        _ => {}
    }
    all.into_iter().map(|link| vec![link]).collect()
}

/// The driven link that rods hold, where moments of one of them give a part of its force.
fn held_by_rods(taken: &[&Taken]) -> Option<LinkId> {
    let driven = |link: LinkId| {
        taken.iter().any(|of| matches!(of.found, TakenFor::Effort(_)) && of.links.contains(&link))
    };
    taken.iter().find_map(|of| match of.found {
        TakenFor::Across { by, .. } => driven(by).then_some(by),
        _ => None,
    })
}

/// The legs of a link are closed once its own polygon, which is laid off first, has given what it exerts on them.
fn closed_by_the_last(bodies: &mut [FreeBody]) {
    if let Some((middle, legs)) = bodies.split_last_mut() {
        middle.gives = true;
        for leg in legs {
            for acting in &mut leg.acting {
                let given = middle.acting.iter().any(|other| same_pair(other.action, acting.action));
                acting.closes &= !given;
            }
            leg.acting.sort_by_key(|acting| acting.closes);
        }
    }
}

/// The forces of a sheet, each once, as quantities.
pub(in super::super) fn quantities(sheet: &ForceSheet) -> Vec<Quantity> {
    let mut all: Vec<Quantity> = Vec::new();
    let of_bodies = sheet.bodies.iter().flat_map(|body| &body.acting);
    for acting in of_bodies.chain(&sheet.whole).chain(&sheet.inertia).chain(&sheet.frame) {
        let quantity = Quantity::Force(Force::Vector(acting.action), sheet.share);
        if !all.contains(&quantity) {
            all.push(quantity);
        }
    }
    let torques = sheet.bodies.iter().flat_map(|body| &body.torques).map(|(torque, _)| *torque);
    // The moment of a force that shifts its line, or of what has none.
    let moments = sheet.moments.iter().filter_map(|moments| match (moments.found.of, moments.about) {
        (Turning::Torque(moment @ Force::Moment(..)), Told::Point(_)) => Some(moment),
        _ => None,
    });
    for torque in torques.chain(moments) {
        let quantity = Quantity::Force(torque, sheet.share);
        if !all.contains(&quantity) {
            all.push(quantity);
        }
    }
    all
}

/// Sums of forces that differ by less than this part of the largest of these are one.
const SAME_SUM: f64 = 1e-9;

impl Draughtsman<'_> {
    /// The bodies of a group in the order that is preferred, or in another one where in that order a polygon would be laid
    /// off before what it needs is found.
    fn reordered(
        &mut self,
        preferred: Vec<Vec<LinkId>>,
        taken: &[&Taken],
        open: &[Closing],
        (joined, found): (&[Vec<LinkId>], &Found),
    ) -> Vec<Chunk> {
        let mut bodies = Vec::new();
        let mut chunks = Vec::new();
        for chunk in &preferred {
            let first = bodies.len();
            bodies.extend(chunk.iter().filter_map(|link| self.free_bodies(*link, joined, found)));
            chunks.push((first..bodies.len()).collect::<Vec<usize>>());
        }
        let moments: Vec<MomentBalance> =
            taken.iter().filter_map(|taken| self.moment_balance(taken, &bodies)).collect();
        let mut told = super::order::Told::new(self.mechanism, &found.known);
        if found.tried {
            let forces = &self.mechanism.forces;
            (0..forces.loads.len()).for_each(|index| told.learn_force(Action::Load(index)));
            (0..forces.springs.len()).for_each(|index| told.learn_force(Action::Spring { index, end: 0 }));
        }
        // What a trial left open and found.
        for closing in open {
            match *closing {
                Closing::Rod { link, near, .. } => {
                    let others = self.mechanism.parties_at(near).into_iter().filter(|other| *other != link);
                    let by = others.into_iter().next().unwrap_or(link);
                    told.learn_along(self.force_at_pin(near, by, link));
                }
                Closing::Slide { slide, .. } => told.learn_force(self.force_of_slide(slide)),
                Closing::Driven { input, .. } => told.learn_force(Action::Drive(input)),
                Closing::Contact { roll, .. } | Closing::Roll { roll } => {
                    let [_, on] = self.mechanism.rolls[roll].bodies();
                    told.learn_force(self.mechanism.force_of_roll(roll, on));
                }
                Closing::Angle { .. } => {}
            }
        }
        let members: Vec<&[LinkId]> = found.members.iter().map(|(links, _)| &links[..]).collect();
        let group = super::order::Group { bodies: &bodies, moments: &moments, members: &members };
        if !told.tells_all(group, &chunks)
            && let Some(order) = told.order(group)
        {
            let links = |body: &usize| match bodies[*body].of {
                Party::Link(link) => Some(link),
                Party::Pin(_) => None,
            };
            let chunk = |chunk: &Vec<usize>| Chunk {
                links: chunk.iter().filter_map(links).collect(),
                gives: chunk.len() > 1,
            };
            return order.iter().map(chunk).collect();
        }
        preferred.into_iter().map(Chunk::of).collect()
    }

    /// The two links whose moments give the parts of a force at a pin of several: one by one, since the polygon of the pin
    /// stands between them. First the one that this force acts on.
    fn one_by_one(&self, taken: &[&Taken], all: &[Vec<LinkId>]) -> Option<Vec<Vec<LinkId>>> {
        let [Taken { found: TakenFor::Across { pin, by, on, .. }, .. }, _] = taken else { return None };
        if !self.is_of_several(*pin) {
            return None;
        }
        let first = match self.force_at_pin(*pin, *by, *on) {
            Action::OnPin(link, _) | Action::OfPin(_, link) => link,
            _ => return None,
        };
        let mut links: Vec<LinkId> = all.iter().flatten().copied().collect();
        links.sort_by_key(|link| *link != first);
        Some(links.into_iter().map(|link| vec![link]).collect())
    }

    /// A link cut free, with those that are taken with it as if they were one.
    fn free_bodies(&mut self, link: LinkId, joined: &[Vec<LinkId>], found: &Found) -> Option<FreeBody> {
        let own = self.free_body(link, found);
        let Some(others) = joined.iter().find(|all| all.first() == Some(&link)) else { return own };
        let mut body = own?;
        for other in &others[1..] {
            let Some(other) = self.free_body(*other, found) else { continue };
            body.acting.extend(other.acting);
            body.torques.extend(other.torques);
        }
        let between = |action: Action| match action {
            Action::Pair { by, on } => [by, on].iter().all(|link| others.contains(link)),
            Action::OfPin(pin, _) => self.mechanism.parties_at(pin).iter().all(|link| others.contains(link)),
            Action::Drive(input) | Action::DriveBack(input) => {
                self.mechanism.driven_between(input).iter().all(|link| others.contains(link))
            }
            Action::Rolling { roll, .. } => {
                self.mechanism.rolls[roll].bodies().iter().all(|link| others.contains(link))
            }
            _ => false,
        };
        body.acting.retain(|acting| !between(acting.action));
        body.acting.sort_by_key(|acting| acting.closes);
        body.with = others[1..].to_vec();
        Some(body)
    }

    /// That several links have two forces together, told at the first body on which one of these acts.
    fn member_told(&self, (links, ends): (Vec<LinkId>, [PointId; 2]), bodies: &[FreeBody]) -> Option<Member> {
        let from_without = |acting: &Acting| match acting.action {
            Action::Pair { by, on } => links.contains(&by) != links.contains(&on),
            Action::Drive(_) | Action::DriveBack(_) => links.len() == 1,
            Action::OfPin(pin, on) => ends.contains(&pin) && links.contains(&on),
            _ => false,
        };
        let told = bodies.iter().position(|body| {
            let ours = body.links().iter().any(|link| links.contains(link));
            let touches = |acting: &Acting| match acting.action {
                Action::Pair { by, .. } => links.contains(&by),
                Action::OfPin(pin, _) => ends.contains(&pin),
                Action::Drive(input) => {
                    self.mechanism.driven_between(input).iter().any(|link| links.contains(link))
                }
                _ => false,
            };
            ours && body.acting.iter().any(from_without) || body.acting.iter().any(touches)
        })?;
        Some(Member { links, ends, told })
    }

    /// Where three forces meet, told at their body: the lines of all of them are known then, and the polygon gives the sizes
    /// of those that the other link of the group and the pin exert.
    fn meet_told(&self, meet: &ThreeForces, bodies: &mut [FreeBody]) -> Option<MeetOfThree> {
        let told = bodies.iter().position(|body| body.of == Party::Link(meet.link))?;
        let group = self.structure.group_of(meet.link)?;
        let links = &self.structure.groups[group].links;
        let of_group =
            |body: &FreeBody| matches!(body.of, Party::Link(l) if l != meet.link && links.contains(&l));
        let mut given: Vec<Action> = Vec::new();
        for body in bodies.iter_mut().filter(|body| of_group(body)) {
            given.extend(body.acting.iter().map(|acting| acting.action));
            if body.acting.len() == 2 {
                body.acting.iter_mut().for_each(|acting| acting.known = acting.known.min(Knowledge::Line));
            }
        }
        let own = &mut bodies[told].acting;
        for acting in &mut *own {
            let found = acting.closes || given.iter().any(|other| same_pair(*other, acting.action));
            if found {
                (acting.known, acting.closes) = (Knowledge::Line, true);
            }
        }
        own.sort_by_key(|acting| acting.closes);
        let per_mm = self.length_scale().si_per_mm;
        let [at, through] = [meet.at, meet.through].map(|place| place.value().map(|mm| mm * per_mm));
        Some(MeetOfThree { told, link: meet.link, at, through })
    }

    /// Whether a load or a spring has no direction here: then nothing that it balances is a stroke.
    fn acts_without_direction(&mut self) -> bool {
        let forces = self.mechanism.forces.clone();
        let aimed = |load: &Load| match load.kind {
            LoadKind::Force { pointing, .. } => {
                matches!(pointing, Pointing::Motion { .. } | Pointing::Between { .. })
            }
            LoadKind::Torque { with_motion, .. } => with_motion.is_some(),
            LoadKind::Vector { .. } => false,
        };
        let loads = forces.loads.iter().enumerate().filter(|(_, load)| aimed(load));
        let loads = loads.map(|(index, _)| Action::Load(index));
        let pulls = |spring: &Spring| matches!(spring.kind, SpringKind::Pull(_));
        let springs = forces.springs.iter().enumerate().filter(|(_, spring)| pulls(spring));
        let springs = springs.map(|(index, _)| Action::Spring { index, end: 0 });
        let mut marks: Vec<u32> = Vec::new();
        for action in loads.chain(springs) {
            let Ok(items) = self.items_of(action, self.told) else { continue };
            for item in items {
                let parts = item.pull.map(|pull| self.components_of(pull));
                marks.extend(parts.into_iter().flatten().chain(item.couple).map(|part| part.mark()));
            }
        }
        let tape = self.board.tape();
        marks.into_iter().any(|mark| tape.weakness(mark).is_some())
    }

    /// A force as it stands on the paper; none where no polygon leads to it.
    pub(super) fn acting(&mut self, action: Action, known: Knowledge) -> Option<Acting> {
        let items = self.items_of(action, self.told).ok()?;
        if items.iter().all(|item| item.pull.is_none()) {
            return None;
        }
        let at = items.first()?.at.value();
        let foot = self.foot_of_line(&items)?.value();
        let sum = self.sum_of(&items);
        // Of what all halves of a governor share the half that is drawn has its part.
        let shared = self.mechanism.halves_of(action);
        let parts = self.components_of(sum);
        // What its own error does not tell from zero has no line.
        let rests = parts.map(|part| self.board.is_no_amount(part)) == [true; 2];
        let (foot, force) = match rests {
            true => (at, [0.0; 2]),
            false => (foot, parts.map(|part| part.value() / shared)),
        };
        // Where nothing moves there is no inertia to be drawn, nor on the axis of a governor.
        if matches!(action, Action::Inertia(_) | Action::Centrifugal(_)) && force == [0.0; 2] {
            return None;
        }
        // The line of inertia that lies off the paper is not drawn: force and couple act side by side at the mass centre.
        let inertia = matches!(action, Action::Inertia(_));
        let beyond = libm::hypot(foot[0] - at[0], foot[1] - at[1]) > REACH * self.size_of_skeleton();
        let with_couple = inertia && beyond;
        let per_mm = self.length_scale().si_per_mm;
        let [at, foot] = [at, foot].map(|place| place.map(|mm| mm * per_mm));
        let through = if with_couple { at } else { foot };
        let closes = known != Knowledge::Full;
        let couple = if force == [0.0; 2] { self.pure_couple(&items) } else { 0.0 };
        Some(Acting { action, at, through, force, known, closes, with_couple, parts: None, couple })
    }

    /// What is left of forces that come to nothing: their moment, which is one about every point.
    pub(super) fn pure_couple(&mut self, items: &[Item]) -> f64 {
        let Some(at) = items.first().map(|item| item.at) else { return 0.0 };
        match self.moments(items, at) {
            Some(moment) if !self.board.is_no_amount(moment) => moment.value(),
            Some(_) | None => 0.0,
        }
    }

    /// The force of a pair that rubs, as it stands on the paper.
    fn touching(&mut self, rub: Rub) -> Option<Touch> {
        let m = self.mechanism;
        let (action, between, point, along) = match rub.pair {
            RubbingPair::Pin { pin, carrier, link } => (Action::OfPin(pin, link), [link, carrier], pin, None),
            RubbingPair::Slide(slide) => {
                let point = m.pin_of_slide(slide)?;
                let guide = m.slides[slide].guide.link;
                let at = self.at(point);
                let (along, _) = self.guide_at(slide, at);
                let (action, on) = match m.party_of(&m.slides[slide].rider) {
                    Party::Link(rider) => (Action::Pair { by: guide, on: rider }, rider),
                    Party::Pin(pin) => (Action::OnPin(guide, pin), *m.point(pin).links.first()?),
                };
                (action, [on, guide], point, Some(along.value()))
            }
        };
        let acting = self.acting(action, Knowledge::Line)?;
        let per_mm = self.length_scale().si_per_mm;
        let at = self.at(point).value().map(|mm| mm * per_mm);
        let turns = |d: &mut Self, link: LinkId| match link == LinkId::FRAME || d.translates[link.0] {
            true => 0.0,
            false => d.rate(Order::Velocity, link).value(),
        };
        let rates = match rub.pair {
            RubbingPair::Pin { .. } => Some(between.map(|link| turns(self, link))),
            RubbingPair::Slide(_) => None,
        };
        Some(Touch { rub, between, at, through: acting.through, force: acting.force, along, rates })
    }

    /// The larger side of the skeleton, paper millimetres.
    fn size_of_skeleton(&self) -> f64 {
        let places = || self.places.iter().flatten().map(|place| place.value());
        let side = |axis: usize| {
            let least = places().map(|place| place[axis]).fold(f64::INFINITY, f64::min);
            let most = places().map(|place| place[axis]).fold(f64::NEG_INFINITY, f64::max);
            most - least
        };
        side(0).max(side(1))
    }

    /// Whether a link has two pins and nothing else acts on it.
    pub(super) fn has_two_forces(&self, link: LinkId) -> bool {
        if link == LinkId::FRAME {
            return false;
        }
        let m = self.mechanism;
        let forces = &m.forces;
        let pins = m.link(link).points.iter().filter(|point| m.is_pin(**point)).count();
        let guides =
            m.slides.iter().any(|s| s.guide.link == link || m.party_of(&s.rider) == Party::Link(link));
        let sprung = forces.springs.iter().any(|spring| match spring.kind {
            SpringKind::Pull(ends) => ends.iter().any(|(of, _)| *of == link),
            SpringKind::Torsion(links) => links.contains(&link),
        });
        // Where something else is sought an input has no effort.
        let driven = m.named_sought().is_empty()
            && (0..m.inputs.len()).any(|input| m.driven_link(input) == Some(link));
        let loaded = forces.mass(link).is_some() || forces.loads.iter().any(|load| load.link == link);
        pins == 2 && !guides && !sprung && !driven && !loaded
    }

    /// What is known of the force of another link when this one is balanced.
    fn knowledge(&self, link: LinkId, other: Option<LinkId>, slides: bool) -> Knowledge {
        let two = self.has_two_forces(link) || other.is_some_and(|other| self.has_two_forces(other));
        if slides || two { Knowledge::Line } else { Knowledge::Nothing }
    }

    /// The force that moments give whole, before any polygon.
    fn given_by_moments(&self, taken: &Taken) -> Option<Action> {
        match taken.found {
            TakenFor::Effort(_) => match taken.links.first().and_then(|link| self.sought_on(*link))? {
                Turning::Force(action) => Some(action),
                _ => None,
            },
            TakenFor::Driven(input) => Some(Action::Drive(input)),
            TakenFor::Across { .. } | TakenFor::Arc(_) => None,
            TakenFor::Along { pin, by, on, .. } if self.carrier_of_whole(pin).is_some() => {
                Some(self.force_at_pin(pin, by, on))
            }
            TakenFor::Along { pin, by, on, .. } => Some(match self.mechanism.parties_at(pin).len() {
                0..=2 => Action::Pair { by, on },
                _ if self.holder(pin) == super::Holder::Link(on) => Action::OfPin(pin, by),
                _ => Action::OfPin(pin, on),
            }),
            TakenFor::Roll { roll, presses: false, .. } if self.keeps_contact(roll) => None,
            TakenFor::Roll { roll, on, .. } => Some(self.mechanism.force_of_roll(roll, on)),
            TakenFor::Slide(slide) | TakenFor::Slot(slide) => Some(self.force_of_slide(slide)),
        }
    }

    /// The force of a sliding pair: of the guide on what rides, or of a bare pin on the guide.
    fn force_of_slide(&self, slide: usize) -> Action {
        let pair = self.mechanism.slides[slide];
        let guide = pair.guide.link;
        match self.mechanism.party_of(&pair.rider) {
            Party::Link(link) => Action::Pair { by: guide, on: link },
            Party::Pin(pin) => match self.mechanism.parties_at(pin)[..] {
                [one, other] => Action::Pair { by: one, on: other },
                _ => Action::OfPin(pin, guide),
            },
        }
    }

    /// The pins of several links that are in balance before this last one of their links is.
    fn pins_before(&self, link: LinkId, bodies: &[FreeBody]) -> Vec<PointId> {
        let m = self.mechanism;
        let shown = |party: Party| match party {
            Party::Link(link) => bodies.iter().any(|body| body.has(link)),
            Party::Pin(_) => bodies.iter().any(|body| body.of == party),
        };
        let pins = (0..m.points.len()).map(PointId).filter(|pin| {
            let parties = m.parties_at(*pin);
            let others = || parties.iter().filter(|other| **other != link);
            parties.len() > 2
                && m.drive_of_pin(*pin).is_none()
                && parties.contains(&link)
                && !shown(Party::Pin(*pin))
                && !parties.contains(&LinkId::FRAME)
                && others().all(|other| shown(Party::Link(*other)))
        });
        pins.collect()
    }

    /// The pins that are cut free once these links are shown: those that are driven along a guide or ride on the frame, or
    /// all.
    fn pins_among(&self, chunk: &[LinkId], all: bool, bodies: &[FreeBody]) -> Vec<PointId> {
        let m = self.mechanism;
        let shown = |link: &LinkId| chunk.contains(link) || bodies.iter().any(|body| body.has(*link));
        let pins = (0..m.points.len()).map(PointId).filter(|pin| {
            let rides = m.slots_at(*pin, LinkId::FRAME) > 0;
            let mut parties = m.parties_at(*pin);
            let many = parties.len() > 2;
            parties.retain(|link| !(rides && *link == LinkId::FRAME));
            (all || rides || m.drive_of_pin(*pin).is_some())
                && (many || self.carrier_of_whole(*pin).is_some())
                && !bodies.iter().any(|body| body.of == Party::Pin(*pin))
                && parties.iter().all(shown)
                && parties.iter().any(|link| chunk.contains(link))
        });
        pins.collect()
    }

    /// Whether the inputs have efforts.
    fn drives_are_sought(&self) -> bool {
        self.mechanism.named_sought().is_empty()
    }

    /// A pin at which several links meet, cut free.
    fn free_pin(&mut self, pin: PointId, found: &Found) -> Option<FreeBody> {
        let mut acting: Vec<Acting> = Vec::new();
        for link in self.mechanism.parties_at(pin) {
            let action = Action::OnPin(link, pin);
            let lined = self.mechanism.slots_at(pin, link) == 1;
            let known = match found.is_known(action) {
                true => Knowledge::Full,
                false => self.knowledge(link, None, lined),
            };
            acting.extend(self.acting(action, known));
        }
        acting.sort_by_key(|acting| acting.known);
        if let Some((input, _)) = self.mechanism.drive_of_pin(pin).filter(|_| self.drives_are_sought()) {
            acting.extend(self.acting(Action::Drive(input), Knowledge::Line));
        }
        let by_moments = |action: Action| found.by_moments.iter().any(|given| same_pair(*given, action));
        for acting in &mut acting {
            acting.closes &= !by_moments(acting.action);
        }
        acting.sort_by_key(|acting| acting.closes);
        let of = Party::Pin(pin);
        (!acting.is_empty()).then_some(FreeBody {
            of,
            with: Vec::new(),
            acting,
            torques: Vec::new(),
            with_next: false,
            gives: false,
        })
    }

    pub(super) fn free_body(&mut self, link: LinkId, found: &Found) -> Option<FreeBody> {
        let m = self.mechanism;
        let forces = m.forces.clone();
        let mut wanted: Vec<(Action, Knowledge)> = Vec::new();
        if let Some(mass) = forces.mass(link) {
            wanted.push((Action::Inertia(mass.link), Knowledge::Full));
            if let Some(spin) = forces.spin {
                let given = matches!(spin.omega, SpinSpeed::Given(_));
                let known = if given { Knowledge::Full } else { Knowledge::Line };
                wanted.push((Action::Centrifugal(mass.link), known));
            }
            if forces.gravity.acts {
                wanted.push((Action::Weight(mass.link), Knowledge::Full));
            }
        }
        if let Some(spin) = forces.spin.filter(|spin| spin.sleeve == Some(link))
            && let Some(drag) = spin.drag
            && spin.sense(self.told, m).is_some()
        {
            wanted.push((Action::Drag(drag.slide), Knowledge::Full));
        }
        for (index, load) in forces.loads.iter().enumerate().filter(|(_, load)| load.link == link) {
            if !load.is_torque() {
                let open = load.is_sought() && !found.tried;
                let known = if open { Knowledge::Line } else { Knowledge::Full };
                wanted.push((Action::Load(index), known));
            }
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            if let SpringKind::Pull(ends) = spring.kind {
                for (end, _) in ends.iter().enumerate().filter(|(_, (of, _))| *of == link) {
                    let open = spring.is_sought() && !found.tried;
                    let known = if open { Knowledge::Line } else { Knowledge::Full };
                    wanted.push((Action::Spring { index, end }, known));
                }
            }
        }
        for pin in (0..m.points.len()).map(PointId) {
            let parties = m.parties_at(pin);
            if parties.len() < 2 || !parties.contains(&link) {
                continue;
            }
            // A pin in a slot is pressed across it.
            let slot = |of: LinkId| m.slots_at(pin, of) == 1;
            match parties[..] {
                _ if self.carrier_of_whole(pin).is_some() => {
                    let lined = slot(link) || found.members.iter().any(|(_, ends)| ends.contains(&pin));
                    wanted.push((Action::OfPin(pin, link), self.knowledge(link, None, lined)));
                }
                [one, other] => {
                    let by = if one == link { other } else { one };
                    let lined = slot(one) || slot(other) || found.is_of_member(link, by);
                    let known = self.knowledge(link, Some(by), lined);
                    wanted.push((Action::Pair { by, on: link }, known));
                }
                _ => wanted.push((Action::OfPin(pin, link), self.knowledge(link, None, slot(link)))),
            }
        }
        for slide in &m.slides {
            let Party::Link(rider) = m.party_of(&slide.rider) else { continue };
            let guide = slide.guide.link;
            if rider == link {
                wanted.push((Action::Pair { by: guide, on: link }, self.knowledge(link, Some(guide), true)));
            } else if guide == link {
                wanted.push((Action::Pair { by: rider, on: link }, self.knowledge(link, Some(rider), true)));
            }
        }
        for (index, roll) in m.rolls.iter().enumerate() {
            if roll.bodies().contains(&link) {
                let known = if self.keeps_contact(index) { Knowledge::Nothing } else { Knowledge::Line };
                wanted.push((m.force_of_roll(index, link), known));
            }
        }
        for (index, input) in m.inputs.iter().enumerate() {
            let Input::Slide { slide, .. } = input else { continue };
            if !self.drives_are_sought() {
                continue;
            }
            let rides = match m.party_of(&m.slides[*slide].rider) {
                Party::Link(rider) => rider == link,
                // At a pin of more links the pin itself is cut free.
                Party::Pin(pin) => {
                    let parties = m.parties_at(pin);
                    parties.len() == 2
                        && self.carrier_of_whole(pin).is_none()
                        && parties.contains(&link)
                        && m.slides[*slide].guide.link != link
                }
            };
            if rides {
                wanted.push((Action::Drive(index), Knowledge::Line));
            } else if m.slides[*slide].guide.link == link {
                wanted.push((Action::DriveBack(index), Knowledge::Line));
            }
        }
        // What is known is laid off first, then what moments give; what the polygon finds closes it.
        let by_moments = |action: Action| found.by_moments.iter().any(|given| same_pair(*given, action));
        for (action, known) in &mut wanted {
            if found.is_known(*action) {
                *known = Knowledge::Full;
            }
        }
        wanted.sort_by_key(|(action, known)| match known {
            Knowledge::Full => 0,
            _ if by_moments(*action) => 1,
            Knowledge::Line => 2,
            Knowledge::Nothing => 3,
        });
        // Within what has two forces together, and at a bare pin that is driven there, a pair passes nothing on.
        let passes_nothing = |own: &Acting| match own.action {
            Action::Pair { by, on } if own.acts_not() => {
                let between = |links: &Vec<LinkId>| match links.len() {
                    1 => links.contains(&by) || links.contains(&on),
                    _ => links.contains(&by) && links.contains(&on),
                };
                found.members.iter().any(|(links, _)| between(links))
            }
            _ => false,
        };
        let mut acting: Vec<Acting> = Vec::new();
        for (action, known) in wanted {
            if acting.iter().all(|other| other.action != action)
                && let Some(own) = self.acting(action, known).filter(|own| !passes_nothing(own))
            {
                acting.push(Acting { closes: known != Knowledge::Full && !by_moments(action), ..own });
            }
        }
        let driven = (0..m.inputs.len()).any(|input| m.driven_link(input) == Some(link));
        let wound = |spring: &Spring| matches!(spring.kind, SpringKind::Torsion(of) if of.contains(&link));
        let turned = m.forces.loads.iter().any(|l| l.link == link && l.is_torque())
            || m.forces.springs.iter().any(wound);
        if let ([one, other], false) = (&mut acting[..], driven || turned)
            && one.known == Knowledge::Full
        {
            // The other one is in its line.
            other.known = other.known.min(Knowledge::Line);
        }
        let shifts = acting.iter().any(|a| a.action == Action::Inertia(link) && !a.with_couple);
        let torques = self.torques_on(link, shifts);
        let of = Party::Link(link);
        (!acting.is_empty()).then_some(FreeBody {
            of,
            with: Vec::new(),
            acting,
            torques,
            with_next: false,
            gives: false,
        })
    }

    /// Torques on a link: efforts, loads, and that of inertia where no inertia force is shifted by it.
    fn torques_on(&mut self, link: LinkId, shifts: bool) -> Vec<(Force, f64)> {
        let m = self.mechanism;
        let mut wanted: Vec<Force> = Vec::new();
        if m.named_sought().is_empty() {
            wanted.extend((0..m.inputs.len()).filter(|i| m.driven_link(*i) == Some(link)).map(Force::Torque));
        }
        for (index, load) in m.forces.loads.iter().enumerate().filter(|(_, load)| load.link == link) {
            if matches!(load.kind, LoadKind::Torque { .. }) {
                wanted.push(Force::LoadTorque(index));
            }
        }
        if let Some(mass) = m.forces.mass(link).copied()
            && !self.translates[link.0]
            && mass.inertia != crate::mechanism::force::Inertia::Point
            && !shifts
        {
            wanted.push(Force::InertiaTorque(link));
        }
        let mut found = Vec::new();
        for force in wanted {
            if let super::ForceRead::Scalar(amount) = self.read_force(force, self.told)
                && (amount.value() != 0.0 || !matches!(force, Force::InertiaTorque(_)))
            {
                found.push((force, amount.value()));
            }
        }
        // The first link of a torsion spring feels the opposite of what its second link does.
        for (index, spring) in m.forces.springs.iter().enumerate() {
            let SpringKind::Torsion([first, second]) = spring.kind else { continue };
            if let (true, super::ForceRead::Scalar(torque)) =
                ([first, second].contains(&link), self.read_force(Force::Twist(index), self.told))
            {
                let value = if second == link { torque.value() } else { -torque.value() };
                found.push((Force::Twist(index), value));
            }
        }
        found
    }

    /// What the loads on drawn links come to whose size changes with the angle of the first input.
    fn sizes_told(&mut self, drawn: impl Fn(LinkId) -> bool) -> Vec<LoadSize> {
        let loads = &self.mechanism.forces.loads;
        let told = |(index, load): (usize, &Load)| load.curve().map(|curve| (index, curve));
        let curves: Vec<(usize, usize)> =
            loads.iter().enumerate().filter(|(_, load)| drawn(load.link)).filter_map(told).collect();
        let mut all = Vec::new();
        for (load, curve) in curves {
            let (angle, height) = (self.angle_of_input().value(), self.height_of_curve(curve).value());
            all.push(LoadSize { load, angle, height });
        }
        all
    }

    /// How the torsion springs on drawn links stand.
    fn twists_told(&mut self, drawn: impl Fn(LinkId) -> bool) -> Vec<SpringTwist> {
        let springs = self.mechanism.forces.springs.clone();
        let mut all = Vec::new();
        for (index, spring) in springs.iter().enumerate() {
            if let (SpringKind::Torsion(links), SpringLaw::Stiffness { free, .. }) = (spring.kind, spring.law)
                && links.iter().any(|link| drawn(*link))
            {
                let further = self.further_turned(links, free);
                all.push(SpringTwist { spring: index, further: further.value() });
            }
        }
        all
    }

    /// The stiffnesses that the balance of a share has found.
    pub(super) fn stiffnesses_told(&mut self, share: Share) -> Vec<Stiffness> {
        let Some((_, balance)) = self.balances.iter().find(|(of, _)| *of == share) else { return Vec::new() };
        let found: Vec<(usize, f64)> = balance
            .efforts
            .iter()
            .filter_map(|(sought, size)| match *sought {
                Sought::Spring(spring) => Some((spring, size.value())),
                _ => None,
            })
            .collect();
        let mut all = Vec::new();
        for (spring, value) in found {
            let own = self.mechanism.forces.springs[spring].clone();
            let SpringLaw::Stiffness { free, .. } = own.law else { continue };
            let longer = match own.kind {
                SpringKind::Pull(ends) => {
                    let per_mm = self.length_scale().si_per_mm;
                    let [a, b] = ends.map(|(_, point)| self.at(point).value());
                    libm::hypot(a[0] - b[0], a[1] - b[1]) * per_mm - free.value
                }
                SpringKind::Torsion(links) => self.further_turned(links, free).value(),
            };
            all.push(Stiffness { spring, value, longer });
        }
        all
    }

    /// Everything that acts on the mechanism from outside.
    fn outer_forces(&mut self) -> Vec<Acting> {
        let m = self.mechanism;
        let forces = m.forces.clone();
        let mut wanted: Vec<(Action, Knowledge)> = Vec::new();
        for mass in &forces.masses {
            wanted.push((Action::Inertia(mass.link), Knowledge::Full));
            if forces.spin.is_some() {
                wanted.push((Action::Centrifugal(mass.link), Knowledge::Line));
            }
            if forces.gravity.acts {
                wanted.push((Action::Weight(mass.link), Knowledge::Full));
            }
        }
        for (index, load) in forces.loads.iter().enumerate().filter(|(_, load)| !load.is_torque()) {
            let known = if load.is_sought() { Knowledge::Line } else { Knowledge::Full };
            wanted.push((Action::Load(index), known));
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            if let SpringKind::Pull(ends) = spring.kind
                && let Some(fixed) = ends.iter().position(|(of, _)| *of == LinkId::FRAME)
            {
                wanted.push((Action::Spring { index, end: 1 - fixed }, Knowledge::Full));
            }
        }
        if let Some(spin) = forces.spin
            && let Some(drag) = spin.drag
            && spin.sense(self.told, m).is_some()
        {
            wanted.push((Action::Drag(drag.slide), Knowledge::Full));
        }
        for sought in m.sought() {
            if let Sought::Effort(input) = sought
                && let Some(Input::Slide { slide, .. }) = m.inputs.get(input)
                && m.slides[*slide].guide.link == LinkId::FRAME
            {
                wanted.push((Action::Drive(input), Knowledge::Full));
            }
        }
        for on in m.moving() {
            let by = LinkId::FRAME;
            for pair in m.pairs_between(by, on) {
                let action = match pair {
                    crate::mechanism::force::Through::Pin(pin) if m.parties_at(pin).len() > 2 => {
                        // A pin that rides on the frame is pressed by it once, whatever meets there.
                        if m.slots_at(pin, by) > 0 { Action::OnPin(by, pin) } else { Action::OfPin(pin, on) }
                    }
                    crate::mechanism::force::Through::Roll(roll) => m.force_of_roll(roll, on),
                    _ => Action::Pair { by, on },
                };
                wanted.push((action, Knowledge::Nothing));
            }
        }
        let mut all: Vec<Acting> = Vec::new();
        for (action, known) in wanted {
            if all.iter().all(|other| other.action != action) {
                all.extend(self.acting(action, known));
            }
        }
        all
    }

    /// Whether somebody asks for a force, its moment or its arm.
    fn asks_for(&self, action: Action) -> bool {
        self.mechanism.asked.iter().any(|asked| match asked.quantity {
            Quantity::Force(Force::Vector(of) | Force::Moment(of, _) | Force::Arm(of, _), _) => of == action,
            _ => false,
        })
    }

    /// What moving links exert on the frame, pair by pair; nothing where these are not its whole force.
    fn on_frame_told(&mut self) -> Vec<Acting> {
        let (m, on) = (self.mechanism, LinkId::FRAME);
        let mut all: Vec<Acting> = Vec::new();
        for by in m.moving() {
            for pair in m.pairs_between(by, on) {
                let action = match pair {
                    crate::mechanism::force::Through::Pin(pin) if m.parties_at(pin).len() > 2 => {
                        Action::OfPin(pin, on)
                    }
                    crate::mechanism::force::Through::Roll(roll) => m.force_of_roll(roll, on),
                    _ => Action::Pair { by, on },
                };
                if all.iter().all(|other| other.action != action) {
                    let acting = self.acting(action, Knowledge::Full);
                    all.extend(acting.filter(|acting| acting.force != [0.0; 2]));
                }
            }
        }
        let Some(whole) = self.acting(Action::OnFrame, Knowledge::Full) else { return Vec::new() };
        let largest = all.iter().map(|a| libm::hypot(a.force[0], a.force[1])).fold(0.0, f64::max);
        let adds_up = [0, 1].iter().all(|&axis| {
            let sum: f64 = all.iter().map(|acting| acting.force[axis]).sum();
            (sum - whole.force[axis]).abs() <= SAME_SUM * largest
        });
        if adds_up { all } else { Vec::new() }
    }
}
