//! Every asked force as a formula over the multipliers and the motion.

use super::constraints::{Formulas, Row, Scope, Site};
use super::model::Tie;
use super::state::{Measured, State};
use super::statics::{Acting, Aim, Balance, Burden, HeavyBody};
use super::tape::{Leaf, Linear, Tape, Var};
use crate::mechanism::force::{Action, Force, Share, Sought, Through, Unaimed};
use crate::mechanism::quantity::{Answer, Indeterminate};
use crate::mechanism::{LinkId, PointId};

/// A force whose bound passes a quarter of it counts as zero: it has no line.
const ZERO: f64 = 4.0;

/// What does not exceed its bound so often points nowhere.
const CLEAR: f64 = 4.0;

/// A contact that would pull with less than this part of the largest force of a pair rests.
const FAINT: f64 = 1e-9;

type Read = Result<Answer, Indeterminate>;

fn undefined<T>(why: impl Into<String>) -> Result<T, Indeterminate> {
    Err(Indeterminate::Undefined { why: why.into() })
}

/// Powers at this instant, watts; they add up to the residual, which is zero within the bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Power {
    /// Of all that is sought.
    pub effort: f64,
    /// Of given loads.
    pub loads: f64,
    /// Of weights.
    pub weights: f64,
    /// Of springs.
    pub springs: f64,
    /// Of inertia.
    pub inertia: f64,
    /// Of friction.
    pub friction: f64,
    /// Their sum.
    pub residual: f64,
    /// How far from zero the sum may be.
    pub bound: f64,
}

impl Power {
    /// The sum is zero within its bound.
    #[must_use]
    pub fn balances(&self) -> bool {
        self.residual.abs() <= self.bound
    }
}

/// Which pair equations make up a force, on which body they are read, and with which sign.
struct Part {
    pair: Through,
    body: usize,
    sign: f64,
}

impl State {
    /// The powers of everything that acts, from the motion and the loads; `None` where no forces were solved or they are
    /// not determined here: what is sought and not found leaves nothing to add up.
    #[must_use]
    pub fn power(&self) -> Option<Power> {
        let sought = self.burden.as_ref()?.sought.len();
        for index in 0..sought {
            self.act(Share::Total, |s| [s.effort(index)]).ok()?;
        }
        let p = self.act(Share::Total, |s| s.powers()).ok()?;
        let unit = self.force_unit() * self.model.length / self.model.time;
        let [effort, loads, weights, springs, inertia, friction, residual] = p.map(|m| m.value * unit);
        Some(Power { effort, loads, weights, springs, inertia, friction, residual, bound: p[6].bound * unit })
    }

    /// The shares in which a rolling pair would have to pull to keep its contact. The parts of loads and of inertia alone
    /// are parts, and may.
    pub(super) fn pulling(&self) -> Vec<(Share, Indeterminate)> {
        let Some(burden) = &self.burden else { return Vec::new() };
        let mut pulling = Vec::new();
        for (share, balance) in &self.balances {
            if matches!(share, Share::Static | Share::Inertia) {
                continue;
            }
            let largest = balance.x[..burden.pairs.len()].iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let pulls = |&(place, sign): &(usize, f64)| {
                let push = self.act(*share, |s| [s.unknown(place)]);
                push.is_ok_and(|[m]| m.value * sign < -m.bound.max(FAINT * largest))
            };
            let contacts = burden.contacts.iter().filter(|(place, sign, _)| pulls(&(*place, *sign)));
            if let Some((_, _, roll)) = contacts.into_iter().next() {
                let why = self.model.mechanism.say_pulls(*roll);
                pulling.push((*share, Indeterminate::NoEquilibrium { why }));
            }
        }
        pulling
    }

    fn force_unit(&self) -> f64 {
        self.model.length / (self.model.time * self.model.time)
    }

    /// Numbers by a formula over multipliers and motion.
    fn act<const N: usize>(
        &self,
        share: Share,
        formula: impl for<'t> Fn(&Acting<'t>) -> [Var<'t>; N],
    ) -> Result<[Measured; N], Indeterminate> {
        let Some(burden) = &self.burden else {
            return undefined("forces were not solved");
        };
        let mechanism = &self.model.mechanism;
        let drags = mechanism.forces.spin.filter(|spin| spin.drag.is_some() || spin.imagined);
        let senseless = drags.is_some_and(|spin| spin.sense(share, mechanism).is_none());
        let Some((_, balance)) = self.balances.iter().find(|(of, _)| *of == share) else {
            return match &self.stuck {
                Some(stuck) => Err(stuck.clone()),
                None => undefined("this part of the forces was not solved"),
            };
        };
        let (order, solved) = (self.motion_order(), self.solved.as_ref());
        let moves = order >= 2;
        let tape = Tape::new(order.max(1));
        let scope = Scope { tape: &tape, motion: self.motion_here(order) };
        let acting = Acting::new(scope, (&self.model, burden), (&balance.x, &balance.strength), share, moves);
        let spin = burden.sought.iter().position(|sought| *sought == Sought::Spin);
        let no_speed = spin.is_some_and(|place| acting.effort(place).value < 0.0);
        let out = formula(&acting);
        // A weight, a given load or the pull of a spring is there in any case; what balances it is not.
        let balanced = |var: &Var<'_>| {
            tape.broken() || tape.sweep(*var).terms.iter().any(|(leaf, _)| matches!(leaf, Leaf::Force(_)))
        };
        if senseless && out.iter().any(balanced) {
            return undefined("the sleeve rests, and its drag has no sense");
        }
        if no_speed && out.iter().any(balanced) {
            // What turns at no speed has no forces.
            let why = "at no speed is there equilibrium".to_owned();
            return Err(Indeterminate::NoEquilibrium { why });
        }
        if tape.broken() {
            let why = burden.unaimed.clone();
            return why.map_or_else(|| undefined("it divides by a length of zero"), Err);
        }
        let pulls = self.pulls.iter().find(|(of, _)| *of == share).map(|(_, why)| why);
        let mut measured = [Measured::default(); N];
        for (slot, var) in measured.iter_mut().zip(out) {
            if let Some(why) = pulls
                && tape.sweep(var).terms.iter().any(|(leaf, _)| matches!(leaf, Leaf::Force(_)))
            {
                return Err(why.clone());
            }
            if let Some(why) = &burden.unaimed
                && self.strays(&tape.sweep(var), burden, balance, share)
            {
                return Err(why.clone());
            }
            if !balance.unbalanced.is_empty()
                && hangs_on(balance, &mut by_forces(&tape.sweep(var), balance), |body| {
                    balance.unbalanced.contains(&body)
                })
            {
                return Err(Indeterminate::Singular);
            }
            if let Some(why) = &self.stuck
                && !self.resting.is_empty()
                && hangs_on(balance, &mut by_forces(&tape.sweep(var), balance), |body| {
                    self.resting.contains(&body)
                })
            {
                return Err(why.clone());
            }
            *slot =
                self.measure(&tape, var, solved, Some(balance)).map_err(|why| match (&self.stuck, why) {
                    (Some(stuck), Indeterminate::Singular) => stuck.clone(),
                    (_, why) => why,
                })?;
        }
        Ok(measured)
    }

    /// Whether a number hangs on the balance of a body on which something without a direction acts, or on what such a
    /// thing would fix.
    fn strays(&self, number: &Linear, burden: &Burden, balance: &Balance, share: Share) -> bool {
        let mut gradient = by_forces(number, balance);
        if gradient.iter().zip(&balance.undetermined).any(|(g, lost)| *lost && *g != 0.0) {
            return true;
        }
        hangs_on(balance, &mut gradient, |body| burden.strays_on(body, share))
    }

    /// What acts without a direction here, because two places are one or nothing moves, and why.
    pub(super) fn unaimed(&self) -> Vec<(Unaimed, Indeterminate)> {
        let Some(burden) = &self.burden else { return Vec::new() };
        let solved = self.solved.as_ref();
        let mut found = Vec::new();
        for (what, aim) in burden.aims() {
            let read = match aim {
                Aim::Between([from, to]) => self.read(0, None, |s| {
                    let (a, b) = (s.site(&from), s.site(&to));
                    [b[0].v - a[0].v, b[1].v - a[1].v]
                }),
                _ if solved.is_none() => continue,
                Aim::Velocity(site) => self.read(1, solved, |s| s.site(&site).map(|c| c.d)),
                Aim::Turning(body) => self.read(1, solved, |s| [s.angle(body).d, s.tape.constant(0.0)]),
            };
            match read {
                Ok([x, y]) if libm::hypot(x.value, y.value) > CLEAR * libm::hypot(x.bound, y.bound) => {}
                Ok(_) => {
                    let why = self.model.mechanism.say_unaimed(what);
                    found.push((what, Indeterminate::Undefined { why }));
                }
                Err(why) => found.push((what, why)),
            }
        }
        found
    }

    /// An asked force.
    pub(super) fn force(&self, force: Force, share: Share) -> Read {
        let (newton, metre) = (self.force_unit(), self.model.length);
        match force {
            Force::Vector(action) => self.vector_force(
                share,
                |s| {
                    let zero = s.real.tape.constant(0.0);
                    let [x, y, _] = self.action(s, action, [zero; 2]);
                    [x, y]
                },
                action,
            ),
            Force::Along { by, on, from } | Force::Across { by, on, from } => {
                let along = matches!(force, Force::Along { .. });
                let action = Action::Pair { by, on };
                let Some(pin) = self.model.mechanism.meeting_point(by, on) else {
                    return undefined("the two links have no pin");
                };
                let (pin, from) = (self.place_site(pin)?, self.place_site(from)?);
                self.vector_force(
                    share,
                    |s| {
                        let zero = s.real.tape.constant(0.0);
                        let [x, y, _] = self.action(s, action, [zero; 2]);
                        let (a, b) = (s.real.site(&from), s.real.site(&pin));
                        let line = [b[0].v - a[0].v, b[1].v - a[1].v];
                        let square = line[0] * line[0] + line[1] * line[1];
                        let part = (x * line[0] + y * line[1]) / square;
                        let parts = [line[0] * part, line[1] * part];
                        if along { parts } else { [x - parts[0], y - parts[1]] }
                    },
                    action,
                )
            }
            Force::Torque(input) => self.sought(share, Sought::Effort(input), newton * metre),
            Force::Drive(input) => self.sought(share, Sought::Effort(input), newton),
            Force::LoadTorque(index) => {
                let [m] = self.act(share, |s| [s.load(&s.burden.loads[index])[2]])?;
                Ok(scalar(m, newton * metre))
            }
            Force::Pull(index) => {
                let [m] = self.act(share, |s| [s.pull(&s.burden.springs[index])])?;
                Ok(scalar(m, newton))
            }
            Force::Spin => {
                let place =
                    self.burden.as_ref().and_then(|b| b.sought.iter().position(|s| *s == Sought::Spin));
                let Some(place) = place else { return undefined("it is not sought here") };
                let [m] = self.act(share, |s| [s.effort(place).sqrt()])?;
                Ok(scalar(m, 1.0 / self.model.time))
            }
            Force::Twist(index) => {
                let [m] = self.act(share, |s| [-s.pull(&s.burden.springs[index])])?;
                Ok(scalar(m, newton * metre))
            }
            Force::InertiaTorque(link) => {
                let [m] = self.act(share, |s| match self.heavy(s, link) {
                    Some(heavy) if share != Share::Static => [s.inertial(heavy).1],
                    _ => [s.real.tape.constant(0.0)],
                })?;
                Ok(scalar(m, newton * metre))
            }
            Force::Offset(link) => {
                let about = self.model.mechanism.forces.mass(link).map(|mass| mass.centre);
                let Some(about) = about else { return undefined("the link has no mass") };
                self.offset(share, link, about)
            }
            Force::Moment(action, about) => {
                let site = self.place_site(about)?;
                self.determined(action)?;
                let [m] = self.act(share, |s| {
                    let place = s.real.site(&site).map(|c| c.v);
                    [self.action(s, action, place)[2]]
                })?;
                Ok(scalar(m, newton * metre))
            }
            Force::Arm(action, about) => self.arm(share, action, about),
        }
    }

    fn arm(&self, share: Share, action: Action, about: PointId) -> Read {
        let site = self.place_site(about)?;
        self.determined(action)?;
        let [square] = self.act(share, |s| {
            let zero = s.real.tape.constant(0.0);
            let [x, y, _] = self.action(s, action, [zero; 2]);
            [x * x + y * y]
        })?;
        if square.value <= ZERO * square.bound {
            return undefined("the force is zero and has no line");
        }
        let [m] = self.act(share, |s| {
            let place = s.real.site(&site).map(|c| c.v);
            let [x, y, moment] = self.action(s, action, place);
            [(moment / (x * x + y * y).sqrt()).abs()]
        })?;
        Ok(scalar(m, self.model.length))
    }

    /// The offset of an inertia force from the mass centre: at infinity where there is a couple alone, nowhere where there
    /// is neither.
    fn offset(&self, share: Share, link: LinkId, centre: PointId) -> Read {
        let [square, couple] = self.act(share, |s| {
            let zero = s.real.tape.constant(0.0);
            let [x, y, _] = self.action(s, Action::Inertia(link), [zero; 2]);
            let couple = match self.heavy(s, link) {
                Some(heavy) if s.inertial_too() => s.inertial(heavy).1,
                _ => zero,
            };
            [x * x + y * y, couple]
        })?;
        if square.value > ZERO * square.bound {
            return self.arm(share, Action::Inertia(link), centre);
        }
        if couple.value.abs() > couple.bound {
            return Ok(Answer::AtInfinity { direction: [1.0, 0.0], bound: 0.0 });
        }
        undefined("neither an inertia force nor a couple acts: there is no line")
    }

    fn sought(&self, share: Share, sought: Sought, unit: f64) -> Read {
        let place = self.burden.as_ref().and_then(|b| b.sought.iter().position(|s| *s == sought));
        let Some(place) = place else { return undefined("it is not sought here") };
        let [m] = self.act(share, |s| [s.effort(place)])?;
        Ok(scalar(m, unit))
    }

    fn vector_force(
        &self,
        share: Share,
        formula: impl for<'t> Fn(&Acting<'t>) -> [Var<'t>; 2],
        action: Action,
    ) -> Read {
        self.determined(action)?;
        let m = self.act(share, formula)?;
        let unit = self.force_unit();
        Ok(Answer::Vector {
            value: m.map(|c| c.value * unit),
            bound: libm::hypot(m[0].bound, m[1].bound) * unit,
        })
    }

    fn heavy<'t>(&self, s: &Acting<'t>, link: LinkId) -> Option<&'t HeavyBody> {
        s.burden.masses.iter().find(|heavy| heavy.link == link)
    }

    /// A point as a site of a body, for its place.
    fn place_site(&self, point: PointId) -> Result<Site, Indeterminate> {
        if let Some(own) = self.model.places[point.0] {
            return Ok(Site { body: 0, own });
        }
        match self.model.sites[point.0].first() {
            Some(site) => Ok(*site),
            None => undefined("a point is in no link"),
        }
    }

    /// Refuses a force that balance does not fix, at a pin of several links about which nothing is said.
    fn determined(&self, action: Action) -> Result<(), Indeterminate> {
        let m = &self.model.mechanism;
        let (by, on) = match action {
            Action::Pair { by, on } => (by, on),
            // Balance fixes every other one.
            _ => return Ok(()),
        };
        for pair in m.pairs_between(by, on) {
            let Through::Pin(pin) = pair else { continue };
            if m.parties_at(pin).len() > 2 && ![Some(by), Some(on)].contains(&m.carrier(pin)) {
                let name = &m.points[pin.0].name;
                return undefined(format!(
                    "balance does not say how links {} and {} share the pin {name}: name its `carrier` in `pins`, or ask for F({name},{})",
                    m.link(by).number,
                    m.link(on).number,
                    m.link(on).number
                ));
            }
        }
        Ok(())
    }

    /// The pair equations of a force between two links.
    fn parts(&self, by: LinkId, on: LinkId) -> Vec<Part> {
        let m = &self.model.mechanism;
        let pairs = m.pairs_between(by, on).into_iter();
        pairs
            .map(|pair| {
                let held_by_on = match pair {
                    Through::Pin(pin) if m.parties_at(pin).len() > 2 => m.carrier(pin) == Some(on),
                    _ => on == LinkId::FRAME,
                };
                let held_by_on = match pair {
                    // The drive of a pin is no force of its pair: the guide feels the pair alone.
                    Through::Pin(pin) => match m.drive_between(pin, [by, on]) {
                        Some((_, guide)) => guide == by,
                        None => held_by_on,
                    },
                    _ => held_by_on,
                };
                let (body, sign) = if held_by_on { (by.0, -1.0) } else { (on.0, 1.0) };
                Part { pair, body, sign }
            })
            .collect()
    }

    /// A force and its moment about a place.
    fn action<'t>(&self, s: &Acting<'t>, action: Action, about: [Var<'t>; 2]) -> [Var<'t>; 3] {
        let tape = s.real.tape;
        let zero = tape.constant(0.0);
        let add = |sum: [Var<'t>; 3], more: [Var<'t>; 3], sign: f64| -> [Var<'t>; 3] {
            let sign = tape.constant(sign);
            [0, 1, 2].map(|i| sum[i] + more[i] * sign)
        };
        let of_tie = |pair: Through| {
            move |tie: Tie| match pair {
                Through::Pin(pin) => tie == Tie::Pin(pin),
                Through::Slide(index) => tie == Tie::Slide(index),
                Through::Roll(index) => tie == Tie::Roll(index),
            }
        };
        let through = |pair: Through, body: usize| {
            let wrench = s.wrench(|_: &Row, tie: Tie| of_tie(pair)(tie), body, about);
            let friction = s.friction_on(|rubbing| of_tie(pair)(rubbing.tie), body, about);
            friction.map_or(wrench, |more| add(wrench, more, 1.0))
        };
        // The frame feels what no body has kept for itself.
        let of_pair = |pair: Through, body: usize| match body {
            0 => (1..self.model.bodies).fold([zero; 3], |sum, body| add(sum, through(pair, body), -1.0)),
            _ => through(pair, body),
        };
        let inertial = |heavy: &HeavyBody| {
            if !s.inertial_too() {
                return [zero; 3];
            }
            let (force, couple) = s.inertial(heavy);
            let centre = s.real.site(&heavy.centre).map(|c| c.v);
            let arm = [centre[0] - about[0], centre[1] - about[1]];
            [force[0], force[1], couple + (arm[0] * force[1] - arm[1] * force[0])]
        };
        match action {
            Action::Pair { by, on } => {
                let parts = self.parts(by, on);
                parts.iter().fold([zero; 3], |sum, part| add(sum, of_pair(part.pair, part.body), part.sign))
            }
            Action::OfPin(pin, link) | Action::OnPin(link, pin) => {
                let sign = if matches!(action, Action::OnPin(..)) { -1.0 } else { 1.0 };
                add([zero; 3], of_pair(Through::Pin(pin), link.0), sign)
            }
            Action::Inertia(link) => self.heavy(s, link).map_or([zero; 3], inertial),
            Action::Centrifugal(link) => self.heavy(s, link).map_or([zero; 3], |heavy| {
                let [x, y] = s.centrifugal(heavy);
                let at = s.real.site(&heavy.centre).map(|c| c.v);
                [x, y, (at[0] - about[0]) * y - (at[1] - about[1]) * x]
            }),
            Action::Shaking => s.burden.masses.iter().fold([zero; 3], |sum, h| add(sum, inertial(h), 1.0)),
            Action::OnFrame => {
                let bodies = 1..self.model.bodies;
                let on_frame = |row: &Row, _: Tie| row.bodies().contains(&0);
                let wrench = |body: usize| {
                    let wrench = s.wrench(on_frame, body, about);
                    let friction = s.friction_on(|rubbing| rubbing.bodies().contains(&0), body, about);
                    friction.map_or(wrench, |more| add(wrench, more, 1.0))
                };
                bodies.fold([zero; 3], |sum, body| add(sum, wrench(body), -1.0))
            }
            Action::Rolling { roll, on } => {
                let [by, on] = self.model.mechanism.bodies_rolling(roll, on);
                match on {
                    LinkId::FRAME => add([zero; 3], through(Through::Roll(roll), by.0), -1.0),
                    _ => through(Through::Roll(roll), on.0),
                }
            }
            Action::Weight(link) => {
                let weight = self.heavy(s, link).and_then(|heavy| Some((heavy, s.weight(heavy)?)));
                weight.map_or([zero; 3], |(heavy, [x, y])| {
                    let at = s.real.site(&heavy.centre).map(|c| c.v);
                    [x, y, (at[0] - about[0]) * y - (at[1] - about[1]) * x]
                })
            }
            Action::Spring { index, end } => {
                let ([x, y], at) = s.spring_on(&s.burden.springs[index], end);
                [x, y, (at[0] - about[0]) * y - (at[1] - about[1]) * x]
            }
            Action::DriveBack(input) => add([zero; 3], self.action(s, Action::Drive(input), about), -1.0),
            Action::Drive(input) => {
                let place = s.burden.sought.iter().position(|sought| *sought == Sought::Effort(input));
                match place.zip(self.model.effort_line(input)) {
                    Some((place, (site, line))) => {
                        let effort = s.effort(place);
                        let [x, y] = s.real.direction(&line).map(|c| c.v * effort);
                        let at = s.real.site(&site).map(|c| c.v);
                        [x, y, (at[0] - about[0]) * y - (at[1] - about[1]) * x]
                    }
                    None => [zero; 3],
                }
            }
            Action::Drag(_) => match s.drag_on_sleeve() {
                Some(([x, y], at)) => [x, y, (at[0] - about[0]) * y - (at[1] - about[1]) * x],
                // Without a sense it is no number.
                None => [tape.constant(1.0) / zero; 3],
            },
            Action::Load(index) => {
                let load = &s.burden.loads[index];
                let [x, y, torque] = s.load(load);
                let moment = match &load.at {
                    Some(at) => {
                        let at = s.real.site(at).map(|c| c.v);
                        (at[0] - about[0]) * y - (at[1] - about[1]) * x
                    }
                    None => torque,
                };
                [x, y, moment]
            }
        }
    }
}

fn scalar(m: Measured, unit: f64) -> Answer {
    Answer::Scalar { value: m.value * unit, bound: m.bound * unit }
}

/// How a number changes with each unknown of a balance.
fn by_forces(number: &Linear, balance: &Balance) -> Vec<f64> {
    let mut gradient = vec![0.0; balance.x.len()];
    for (leaf, slope) in &number.terms {
        if let Leaf::Force(at) = leaf {
            gradient[*at] += slope;
        }
    }
    gradient
}

/// Whether a number with this gradient towards the unknowns, of which none is left, hangs on the balance of such a body.
fn hangs_on(balance: &Balance, gradient: &mut [f64], is_such: impl Fn(usize) -> bool) -> bool {
    let behind = balance.system.adjoint(gradient).rows;
    // Three balances of each body, the frame has none.
    behind.iter().any(|(row, weight)| *weight != 0.0 && is_such(row / 3 + 1))
}
