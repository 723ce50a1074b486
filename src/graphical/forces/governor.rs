//! A governor as a textbook solves it: the sleeve along its guide, moments of the arm that carries the ball, and M ω² r.
//!
//! What is told here of a balance that is drawn already: which body comes first, and about which point its moments are
//! taken. An arm that turns about a fixed pivot has its moments about that; one that hangs on the sleeve and is led by the
//! frame has them about its instantaneous centre.

use crate::board::{Line, Point};
use crate::mechanism::force::{Action, Force, Mass, Party, Share, Sought, SpringKind};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::spin::{Spin, SpinSpeed};
use crate::mechanism::{Input, LinkId, Path, PointId};
use crate::plan::Plan;

use super::super::construction::{
    About, Acting, AlongGuide, ForceSheet, FreeBody, Governor, GovernorState, Knowledge, MassForces,
    MomentBalance, MomentTerm, Turning,
};
use super::super::draughtsman::Draughtsman;
use super::Pull;
use super::record::Found;

/// Directions of which the sine of the angle between them is smaller are parallel.
const PARALLEL: f64 = 1e-9;

/// What joins the arm to the sleeve or to the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Tie {
    /// A pin: its force may point anywhere.
    Joint(PointId),
    /// A bar with two pins, or a roller: the line of its force is known.
    Line { pin: PointId, by: LinkId },
}

/// A way from the arm to the sleeve or to the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Way {
    /// The force on the arm.
    action: Action,
    tie: Tie,
    /// The bar or the roller between.
    through: Option<LinkId>,
    end: LinkId,
}

/// How a governor is built.
#[derive(Debug, Clone)]
struct Layout {
    spin: Spin,
    mass: Mass,
    arm: LinkId,
    /// The sleeve with its pair on the frame.
    sleeve: Option<(LinkId, usize)>,
    to_sleeve: Option<Way>,
    to_frame: Way,
    /// What is sought acts on the arm, and not on the sleeve.
    sought_on_arm: bool,
}

/// The free bodies of a governor whose one ball hangs on one arm; none of any other.
pub(super) fn record(d: &mut Draughtsman<'_>, plan: &Plan) -> Option<ForceSheet> {
    let layout = d.governor_layout()?;
    let drawn = |share: &Share| {
        let balance = d.balances.iter().find(|(of, _)| of == share);
        balance.is_some_and(|(_, balance)| balance.refused.is_none())
    };
    let shares: Vec<Share> = [Share::Total, Share::Rising, Share::Falling]
        .into_iter()
        .filter(|share| plan.forces.shares.contains(share) && drawn(share))
        .collect();
    let first = *shares.first()?;
    d.told = first;
    let sheet = d.governor_sheet(&layout, &shares);
    d.told = Share::Total;
    let stiffnesses = d.stiffnesses_told(first);
    sheet.map(|sheet| ForceSheet { share: first, stiffnesses, ..sheet })
}

impl Draughtsman<'_> {
    /// How the mechanism is built as a governor, where it is one arm with a ball, perhaps a sleeve, and what joins them.
    fn governor_layout(&mut self) -> Option<Layout> {
        let m = self.mechanism;
        let spin = m.forces.spin?;
        // Where pins rub the arm has forces beside its pins: it is told by its free bodies.
        if !m.forces.friction.is_empty() {
            return None;
        }
        let sleeve = self.sleeve_of(&spin);
        let mut off_axis = m.forces.masses.clone();
        // What the halves of the sleeve exert on each other square to the axis is no force of the whole.
        off_axis.retain(|mass| {
            sleeve.is_none_or(|(link, _)| link != mass.link)
                && self.beside_axis(&spin, mass.centre).is_some_and(|(mm, _)| mm.abs() > 0.02)
        });
        let [mass] = off_axis[..] else { return None };
        let arm = mass.link;
        let (mut to_sleeve, mut to_frame) = (None, None);
        let mut parts = vec![arm];
        parts.extend(sleeve.map(|(link, _)| link));
        let slides = m.slides.iter().any(|s| s.guide.link == arm || m.party_of(&s.rider) == Party::Link(arm));
        if slides || sleeve.is_some_and(|(link, _)| link == arm) {
            return None;
        }
        for pin in m.link(arm).points.iter().copied().filter(|pin| m.parties_at(*pin).len() > 1) {
            let way = self.way_from(arm, pin, sleeve.map(|(link, _)| link))?;
            let side = if way.end == LinkId::FRAME { &mut to_frame } else { &mut to_sleeve };
            if side.replace(way).is_some() {
                return None;
            }
            parts.extend(way.through);
        }
        let to_frame = to_frame?;
        // One unknown for each equation: moments about a pivot, or about the centre of an arm that is led.
        match (to_frame.tie, to_sleeve.map(|way: Way| way.tie)) {
            (Tie::Joint(_), None | Some(Tie::Line { .. })) | (Tie::Line { .. }, Some(Tie::Joint(_))) => {}
            _ => return None,
        }
        if m.moving().any(|link| !parts.contains(&link)) || (sleeve.is_some() && to_sleeve.is_none()) {
            return None;
        }
        let sleeve_link = sleeve.map(|(link, _)| link);
        let on =
            |links: &[LinkId]| match (links.contains(&arm), links.iter().any(|l| Some(*l) == sleeve_link)) {
                (true, false) => Some(true),
                (false, true) => Some(false),
                _ => None,
            };
        let sought_on_arm = match m.sought()[..] {
            [Sought::Spin] => true,
            [Sought::Load(index)] => on(&[m.forces.loads[index].link])?,
            [Sought::Spring(index)] => match m.forces.springs[index].kind {
                SpringKind::Pull(ends) => on(&ends.map(|(link, _)| link))?,
                SpringKind::Torsion(_) => return None,
            },
            [Sought::Effort(input)] => match m.inputs.get(input)? {
                Input::Slide { slide, .. } => {
                    sleeve.is_some_and(|(_, own)| own == *slide).then_some(false)?
                }
                _ => on(&[m.driven_link(input)?])?,
            },
            _ => return None,
        };
        // A spring between arm and sleeve is in both equations, and a torsion spring in none.
        let simple = m.forces.springs.iter().all(|spring| match spring.kind {
            SpringKind::Pull(ends) => on(&ends.map(|(link, _)| link)).is_some(),
            SpringKind::Torsion(_) => false,
        });
        simple.then_some(Layout { spin, mass, arm, sleeve, to_sleeve, to_frame, sought_on_arm })
    }

    /// How far a point lies from the axis, to its left positive, mm, and its foot there.
    fn beside_axis(&mut self, spin: &Spin, point: PointId) -> Option<(f64, Point)> {
        self.places[point.0].as_ref()?;
        let at = self.at(point);
        let through = self.prick_world(spin.through);
        let angle = self.board.angle(spin.angle);
        let along = self.board.protractor(angle);
        let [beside, across] = self.board.square_off(Line { through, along }, at);
        let foot = self.board.step_off(through, along, beside);
        Some((across.value(), foot))
    }

    /// The sleeve with its pair: the link that the scene names, or the one that slides on the frame along the axis.
    fn sleeve_of(&mut self, spin: &Spin) -> Option<(LinkId, usize)> {
        let m = self.mechanism;
        let mut found = None;
        for (index, slide) in m.slides.iter().enumerate() {
            let (Party::Link(rider), Path::Straight { .. }) = (m.party_of(&slide.rider), &slide.guide.path)
            else {
                continue;
            };
            if slide.guide.link != LinkId::FRAME {
                continue;
            }
            let pin = self.mechanism.pin_of_slide(index)?;
            let at = self.at(pin);
            let (along, _) = self.guide_at(index, at);
            let ([x, y], (sin, cos)) = (along.value(), libm::sincos(spin.angle.value));
            let parallel = (x * sin - y * cos).abs() < PARALLEL;
            if spin.sleeve.map_or(parallel, |named| named == rider) && found.replace((rider, index)).is_some()
            {
                return None;
            }
        }
        found
    }

    /// Whither a pin of the arm leads.
    fn way_from(&self, arm: LinkId, pin: PointId, sleeve: Option<LinkId>) -> Option<Way> {
        let m = self.mechanism;
        let ends = |link: LinkId| link == LinkId::FRAME || Some(link) == sleeve;
        let beyond = |pin: PointId, from: LinkId| match m.parties_at(pin)[..] {
            [one, other] => Some(if one == from { other } else { one }),
            _ => None,
        };
        let next = beyond(pin, arm)?;
        let action = Action::Pair { by: next, on: arm };
        let bare = m.slides.iter().any(|s| m.party_of(&s.rider) == Party::Pin(pin));
        if ends(next) {
            let tie = if bare { Tie::Line { pin, by: next } } else { Tie::Joint(pin) };
            return Some(Way { action, tie, through: None, end: next });
        }
        let tie = Tie::Line { pin, by: next };
        let way = |end: LinkId| ends(end).then_some(Way { action, tie, through: Some(next), end });
        if self.has_two_forces(next) {
            let far = m.link(next).points.iter().copied().find(|p| *p != pin && m.is_pin(*p))?;
            return way(beyond(far, next)?);
        }
        let rides = |slide: &&crate::mechanism::Slide| m.party_of(&slide.rider) == Party::Link(next);
        let mut guides = m.slides.iter().filter(rides);
        let (Some(guide), None) = (guides.next(), guides.next()) else { return None };
        let bare = m.forces.mass(next).is_none() && m.forces.loads.iter().all(|load| load.link != next);
        if !bare || m.link(next).points.len() != 1 {
            return None;
        }
        way(guide.guide.link)
    }

    fn governor_sheet(&mut self, layout: &Layout, shares: &[Share]) -> Option<ForceSheet> {
        let m = self.mechanism;
        let bodies = self.bodies_of_governor(layout);
        let place = |link: LinkId| bodies.iter().position(|body| body.of == Party::Link(link));
        let arm = place(layout.arm)?;
        let (mm, foot) = self.beside_axis(&layout.spin, layout.mass.centre)?;
        let per_mm = self.length_scale().si_per_mm;
        let ball = self.at(layout.mass.centre).value().map(|mm| mm * per_mm);
        let mut states: Vec<GovernorState> = Vec::new();
        // Where nothing rubs the sleeve rises and falls at one speed.
        let one_speed = layout.spin.drag.is_none() && m.forces.friction.is_empty();
        for share in shares.iter().take(if one_speed { 1 } else { shares.len() }) {
            self.told = *share;
            let mut moments = self.moments_of_arm(layout, &bodies[arm], arm)?;
            // The arms are those of one drawing, whatever acts.
            if let Some(first) = states.first() {
                let known = || first.moments.terms.iter().chain([&first.moments.found]);
                for term in moments.terms.iter_mut().chain([&mut moments.found]) {
                    if let Some(other) = known().find(|other| other.of == term.of) {
                        term.arm = other.arm;
                    }
                }
            }
            let sleeve = layout.sleeve.and_then(|(sleeve, slide)| Some((place(sleeve)?, slide)));
            let along = match sleeve {
                Some((sleeve, slide)) => Some(self.along_guide(layout, &bodies[sleeve], slide)?),
                None => None,
            };
            let omega = match layout.spin.omega {
                SpinSpeed::Given(omega) => omega.value,
                SpinSpeed::Sought => libm::sqrt(self.sought_spin(*share)?.max(0.0)),
            };
            let centrifugal = self.acting(Action::Centrifugal(layout.arm), Knowledge::Full)?;
            let centrifugal = libm::hypot(centrifugal.force[0], centrifugal.force[1]);
            states.push(GovernorState { share: *share, omega, centrifugal, along, moments });
        }
        self.told = *shares.first()?;
        let mut masses = Vec::new();
        for mass in m.forces.masses.clone() {
            let kilograms = self.kilograms(&mass).map(|m| m.value());
            let weight = self.weight(&mass).map(|pull| {
                let [x, y] = self.components_of(pull).map(|part| part.value());
                libm::hypot(x, y)
            });
            masses.push(MassForces {
                link: mass.link,
                centre: mass.centre,
                mass: kilograms,
                inertia: None,
                weight,
                acceleration: 0.0,
                alpha: None,
            });
        }
        let kilograms = self.kilograms(&layout.mass)?.value();
        let hands_on = |way: Way| match (way.action, way.through) {
            (on_arm @ Action::Pair { on, .. }, Some(link)) => {
                Some((link, on_arm, Action::Pair { by: link, on: way.end })).filter(|_| on == layout.arm)
            }
            _ => None,
        };
        let all = m.forces.loads.iter().enumerate();
        let curves: Vec<usize> =
            all.filter(|(_, load)| load.curve().is_some()).map(|(index, _)| index).collect();
        let governor = Governor {
            arm,
            link: layout.arm,
            sleeve: layout.sleeve.and_then(|(sleeve, _)| place(sleeve)),
            centre: layout.mass.centre,
            mass: kilograms,
            radius: mm.abs() * per_mm,
            foot: foot.value().map(|mm| mm * per_mm),
            ball,
            hands_on: layout.to_sleeve.and_then(hands_on),
            sought: layout.spin.omega == SpinSpeed::Sought,
            closes: self.asks_of_frame(layout),
            states,
        };
        let moments = governor.states.first().map(|state| state.moments.clone());
        curves.is_empty().then(|| ForceSheet {
            masses,
            bodies,
            moments: moments.into_iter().collect(),
            governor: Some(governor),
            ..ForceSheet::default()
        })
    }

    fn sought_spin(&mut self, share: Share) -> Option<f64> {
        let (_, balance) = self.balances.iter().find(|(of, _)| *of == share)?;
        balance.efforts.iter().find(|(of, _)| *of == Sought::Spin).map(|(_, square)| square.value())
    }

    /// Sleeve, bar and arm cut free, in the order in which one gives the next.
    fn bodies_of_governor(&mut self, layout: &Layout) -> Vec<FreeBody> {
        let m = self.mechanism;
        let bar = |way: Way| way.through.filter(|link| !m.link(*link).block);
        let mut order: Vec<LinkId> = layout.sleeve.into_iter().map(|(sleeve, _)| sleeve).collect();
        order.extend(layout.to_sleeve.and_then(bar));
        order.push(layout.arm);
        if !layout.sought_on_arm {
            order.reverse();
        }
        // A bar to the frame gives the line of its force.
        if let Some(place) = order.iter().position(|link| *link == layout.arm) {
            order.splice(place..place, bar(layout.to_frame));
        }
        let by_moments = match (layout.sought_on_arm, layout.to_sleeve) {
            (false, Some(way)) => vec![way.action],
            _ => self.sought_on_arm(layout).into_iter().collect(),
        };
        let mut found = Found::of_moments(by_moments);
        let handed = layout.to_sleeve.filter(|way| way.through.is_some_and(|link| m.link(link).block));
        let mut bodies: Vec<FreeBody> = Vec::new();
        for link in order {
            let Some(mut body) = self.free_body(link, &found) else { continue };
            for acting in &mut body.acting {
                // A roller hands on what it gets; of a pin at the sleeve only the part along its guide is known.
                match layout.to_sleeve.filter(|_| !bodies.is_empty()) {
                    Some(way) if Some(way) == handed && self.is_between(acting.action, way) => {
                        (acting.known, acting.closes) = (Knowledge::Full, false);
                    }
                    Some(Way { tie: Tie::Joint(_), action, .. })
                        if super::moments::same_pair(acting.action, action) =>
                    {
                        (acting.known, acting.closes) = (Knowledge::Nothing, true);
                    }
                    _ => {}
                }
                // A bar or a roller has the line of its force.
                let led = matches!(layout.to_frame.tie, Tie::Line { .. });
                if led && acting.action == layout.to_frame.action {
                    acting.known = acting.known.min(Knowledge::Line);
                }
                // The halves hold each other in the guide: no couple is left that would move its force.
                if layout.sleeve.is_some_and(|(sleeve, _)| {
                    acting.action == Action::Pair { by: LinkId::FRAME, on: sleeve }
                }) {
                    acting.through = acting.at;
                }
            }
            // What the halves hold against each other is no force of the whole.
            let outward = body.acting.iter().position(|acting| {
                layout.sleeve.is_some_and(|(sleeve, _)| acting.action == Action::Centrifugal(sleeve))
            });
            if let Some(outward) = outward.map(|place| body.acting.remove(place)) {
                let held =
                    |acting: &&mut Acting| matches!(acting.action, Action::Pair { by: LinkId::FRAME, .. });
                if let Some(held) = body.acting.iter_mut().find(held) {
                    held.force = [0, 1].map(|axis| held.force[axis] + outward.force[axis]);
                    let rests = libm::hypot(held.force[0], held.force[1])
                        <= PARALLEL * libm::hypot(outward.force[0], outward.force[1]);
                    held.force = if rests { [0.0; 2] } else { held.force };
                }
            }
            body.acting.retain(|acting| acting.force != [0.0; 2]);
            // A sleeve that bears nothing, and what ties it to the arm.
            if body.acting.is_empty() {
                continue;
            }
            body.acting.sort_by_key(|acting| acting.closes);
            // Of a bar to the frame nothing is found yet but the line of its force.
            if layout.to_frame.through != Some(link) {
                found.learn(std::slice::from_ref(&body));
            }
            bodies.push(body);
        }
        bodies
    }

    /// Whether somebody asks what the frame exerts on the arm, which its polygon gives.
    fn asks_of_frame(&self, layout: &Layout) -> bool {
        self.mechanism.asked.iter().any(|asked| match asked.quantity {
            Quantity::Force(Force::Vector(action) | Force::Moment(action, _) | Force::Arm(action, _), _) => {
                super::moments::same_pair(action, layout.to_frame.action) || action == Action::OnFrame
            }
            _ => false,
        })
    }

    fn is_between(&self, action: Action, way: Way) -> bool {
        let Action::Pair { by, on } = action else { return false };
        way.through.is_some_and(|link| [by, on].contains(&link))
    }

    /// What is sought on the arm, as a force.
    fn sought_on_arm(&self, layout: &Layout) -> Option<Action> {
        match self.mechanism.sought()[..] {
            [Sought::Spin] => Some(Action::Centrifugal(layout.arm)),
            [Sought::Load(index)] => Some(Action::Load(index)),
            [Sought::Spring(index)] => match self.mechanism.forces.springs[index].kind {
                SpringKind::Pull(ends) => {
                    let end = ends.iter().position(|(link, _)| *link == layout.arm)?;
                    Some(Action::Spring { index, end })
                }
                SpringKind::Torsion(_) => None,
            },
            _ => None,
        }
    }

    /// The point about which the moments of the arm are taken.
    fn moment_point(&mut self, layout: &Layout) -> Option<(About, Point)> {
        let (pin, by) = match layout.to_frame.tie {
            Tie::Joint(pivot) => return Some((About::Point(pivot), self.at(pivot))),
            Tie::Line { pin, by } => (pin, by),
        };
        let (Some(Way { tie: Tie::Joint(joint), .. }), Some((_, slide))) = (layout.to_sleeve, layout.sleeve)
        else {
            return None;
        };
        let m = self.mechanism;
        let led = m.slides.iter().position(|s| {
            let party = m.party_of(&s.rider);
            party == Party::Pin(pin) || party == Party::Link(by)
        });
        let at = self.at(pin);
        let reason = self.reason(&[layout.arm]);
        let along = match led {
            Some(led) => self.guide_at(led, at).1,
            None => {
                let far = m.link(by).points.iter().copied().find(|p| *p != pin && m.is_pin(*p))?;
                let far = self.at(far);
                self.board.toward(at, far, reason).0
            }
        };
        let joint_at = self.at(joint);
        let (_, square) = self.guide_at(slide, joint_at);
        let first = Line { through: at, along };
        let second = Line { through: joint_at, along: square };
        let meet = self.board.meet_lines(first, second, reason).at;
        let per_mm = self.length_scale().si_per_mm;
        let [of, joint_place] = [at, joint_at].map(|point| point.value().map(|mm| mm * per_mm));
        let about = About::Centre {
            of: layout.arm,
            line: layout.to_frame.action,
            joint,
            from: [of, joint_place],
            at: meet.value().map(|mm| mm * per_mm),
        };
        Some((about, meet))
    }

    /// Moments of the arm: of what acts on it but what the frame exerts.
    fn moments_of_arm(&mut self, layout: &Layout, body: &FreeBody, told: usize) -> Option<MomentBalance> {
        let (about, point) = self.moment_point(layout)?;
        let tied = layout.to_sleeve.map(|way| way.action);
        let mut terms: Vec<MomentTerm> = Vec::new();
        for acting in body.acting.iter().filter(|acting| acting.action != layout.to_frame.action) {
            let joint = match layout.to_sleeve.map(|way| way.tie) {
                Some(Tie::Joint(joint)) if Some(acting.action) == tied => Some(joint),
                _ => None,
            };
            let term = match joint {
                Some(joint) => self.part_along_guide(layout, acting.action, (joint, point)),
                None => self.moment_term(acting.action, point, None),
            };
            terms.extend(term);
        }
        let torque = |(of, value): &(Force, f64)| MomentTerm {
            of: Turning::Torque(*of),
            size: value.abs(),
            arm: None,
            moment: *value,
        };
        terms.extend(body.torques.iter().map(torque));
        let effort = |of: &Turning| matches!(of, Turning::Torque(Force::Torque(_)));
        let sought = self.sought_on_arm(layout);
        let is_found = |term: &MomentTerm| match (layout.sought_on_arm, term.of) {
            (true, of) if effort(&of) => true,
            (true, Turning::Force(action)) => Some(action) == sought,
            (false, Turning::Force(action) | Turning::Across(action)) => Some(action) == tied,
            _ => false,
        };
        let place = terms.iter().position(is_found)?;
        let found = terms.remove(place);
        terms.retain(|term| term.moment != 0.0);
        let moments = MomentBalance { links: vec![layout.arm], told, about, terms, found, carried: None };
        Some(self.with_shared_arms(moments))
    }

    /// The part along the guide of the sleeve of what it exerts on the arm.
    fn part_along_guide(
        &mut self,
        layout: &Layout,
        action: Action,
        (joint, about): (PointId, Point),
    ) -> Option<MomentTerm> {
        let (_, slide) = layout.sleeve?;
        let items = self.items_of(action, self.told).ok()?;
        let whole = self.sum_of(&items);
        let at = self.at(joint);
        let (along, _) = self.guide_at(slide, at);
        let [size, _] = self.board.square_off(Line { through: whole.tail, along }, whole.head);
        let head = self.board.step_off(whole.tail, along, size);
        self.term_of_pull(Turning::Across(action), Pull { tail: whole.tail, head }, at, about)
    }

    /// The forces on the sleeve along its guide.
    fn along_guide(&mut self, layout: &Layout, body: &FreeBody, slide: usize) -> Option<AlongGuide> {
        let pin = self.mechanism.pin_of_slide(slide)?;
        let at = self.at(pin);
        let (along, _) = self.guide_at(slide, at);
        let guide = along.value();
        let way = layout.to_sleeve?;
        let sought = match (layout.sought_on_arm, &self.mechanism.sought()[..]) {
            (true, _) => None,
            (false, [Sought::Load(index)]) => Some(Action::Load(*index)),
            (false, [Sought::Spring(index)]) => {
                let of = |acting: &&Acting| matches!(acting.action, Action::Spring { index: own, .. } if own == *index);
                body.acting.iter().find(of).map(|acting| acting.action)
            }
            (false, [Sought::Effort(input)]) => Some(Action::Drive(*input)),
            _ => return None,
        };
        let of_arm = |action: Action| match action {
            Action::Pair { by, on } => {
                let other = way.through.unwrap_or(layout.arm);
                [by, on].contains(&other)
            }
            _ => false,
        };
        let mut found = None;
        let (mut terms, mut inclined) = (Vec::new(), false);
        for acting in &body.acting {
            let now = self.acting(acting.action, acting.known)?.force;
            let part = now[0] * guide[0] + now[1] * guide[1];
            let size = libm::hypot(now[0], now[1]);
            if part.abs() <= PARALLEL * size {
                continue;
            }
            let leans = (now[0] * guide[1] - now[1] * guide[0]).abs() > PARALLEL * size;
            let tied = of_arm(acting.action);
            let partly = matches!(way.tie, Tie::Joint(_)) && tied;
            inclined |= leans && !partly;
            let own = if leans && !partly { size.copysign(part) } else { part };
            if sought.map_or(tied, |sought| sought == acting.action) {
                found = Some((acting.action, own, partly));
            } else {
                terms.push((acting.action, own, partly));
            }
        }
        let (action, size, partly) = found?;
        Some(AlongGuide {
            found: (action, size.abs(), partly),
            terms: terms
                .into_iter()
                .map(|(of, part, partly)| (of, part.abs(), partly, part * size < 0.0))
                .collect(),
            inclined,
            angle: libm::atan2(guide[1], guide[0]),
        })
    }
}
