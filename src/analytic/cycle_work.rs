//! The work of a mechanism's own torque from energies: at constant speed T dθ is what kinetic energy, the weights and the
//! springs gain, less what the loads give. Loads of one size and direction have a potential too; the work of others is an
//! integral of their power, by the rule of Gauss and Kronrod.

use std::cell::RefCell;
use std::collections::BTreeMap;

use super::cycle::{Known, Standing, Told};
use super::tape::U;
use super::{State, solve_for};
use crate::mechanism::force::{
    Area, Force, Heaviness, Inertia, LoadKind, Pointing, Pressure, Share, Size, Spring, SpringKind, SpringLaw,
};
use crate::mechanism::quantity::{Answer, Quantity};
use crate::mechanism::{Input, LinkId, Mechanism, PointId};

/// So far beside a place where a load has no direction it has one, radians.
const BESIDE: f64 = 1e-6;
/// Steps of a period in which torsion springs are followed.
const FOLLOWED: u32 = 144;
/// Pieces of a turn between which powers are integrated, and parts of one in which a load turns back no more than once.
const PIECES: u32 = 12;
const PARTS: u32 = 3;
/// A piece whose integral is not known to this part of it is halved, so often.
const FINE: f64 = 1e-13;
const HALVINGS: u32 = 3;
/// Nodes and weights of the rule of fifteen points, and the weights of the seven of Gauss among them.
const NODES: [f64; 8] = [
    0.991_455_371_120_812_6,
    0.949_107_912_342_758_5,
    0.864_864_423_359_769_1,
    0.741_531_185_599_394_4,
    0.586_087_235_467_691_1,
    0.405_845_151_377_397_2,
    0.207_784_955_007_898_47,
    0.0,
];
const KRONROD: [f64; 8] = [
    0.022_935_322_010_529_224,
    0.063_092_092_629_978_55,
    0.104_790_010_322_250_18,
    0.140_653_259_715_525_9,
    0.169_004_726_639_267_9,
    0.190_350_578_064_785_4,
    0.204_432_940_075_298_9,
    0.209_482_141_084_727_8,
];
const GAUSS: [f64; 4] =
    [0.129_484_966_168_869_7, 0.279_705_391_489_276_67, 0.381_830_050_505_118_9, 0.417_959_183_673_469_4];

/// A mechanism's own torque over the angle of its input.
pub(super) struct OwnTorque<'a> {
    standing: Standing<'a>,
    sign: f64,
    torques: RefCell<BTreeMap<u64, Known>>,
    /// Work from angle 0, and what has a potential, where they were asked for.
    works: RefCell<BTreeMap<u64, Known>>,
    energies: RefCell<BTreeMap<u64, Known>>,
    /// Work of loads without a potential from one piece to the next, by the place of the piece.
    pieces: RefCell<BTreeMap<i64, Known>>,
    /// Where the curves of loads bend or leap, each with the angle after which it comes again.
    knots: Vec<[f64; 2]>,
    rubs: bool,
    /// Whether there is a load or a spring that has no potential.
    works_otherwise: bool,
    /// Whether a load is against a motion, or with it.
    follows_motion: bool,
}

impl<'a> OwnTorque<'a> {
    /// The torque of a mechanism over a period of its input.
    ///
    /// # Errors
    /// Why the period does not close.
    pub(super) fn new(standing: Standing<'a>, sign: f64, period: f64) -> Told<Self> {
        standing(0.0).map_or(Ok(()), |mechanism| wound_up_as_before(&mechanism, standing, period))?;
        let mut own = Self {
            standing,
            sign,
            torques: RefCell::default(),
            works: RefCell::default(),
            energies: RefCell::default(),
            pieces: RefCell::default(),
            knots: Vec::new(),
            rubs: false,
            works_otherwise: false,
            follows_motion: false,
        };
        if let Some(mechanism) = standing(0.0) {
            let knots = mechanism.forces.knots();
            own.knots = knots.iter().map(|knot| knot.map(|given| given.value)).collect();
            own.rubs = !mechanism.rubbing_pairs().is_empty();
            own.follows_motion = mechanism.forces.loads.iter().any(|load| load.follows_motion());
            own.works_otherwise = !own.without_potential(0.0)?.forces.is_empty();
        }
        Ok(own)
    }

    /// What is known already at an angle, or is found now.
    fn once(
        known: &RefCell<BTreeMap<u64, Known>>,
        at: f64,
        find: impl FnOnce() -> Told<Known>,
    ) -> Told<Known> {
        if let Some(known) = known.borrow().get(&at.to_bits()) {
            return Ok(*known);
        }
        let found = find()?;
        known.borrow_mut().insert(at.to_bits(), found);
        Ok(found)
    }

    /// Where the curves of loads bend or leap, each with the angle after which it comes again.
    pub(super) fn knots(&self) -> &[[f64; 2]] {
        &self.knots
    }

    /// The angle itself; at a knot one beside it, on the side from which one comes.
    pub(super) fn beside(&self, at: f64, after: bool) -> f64 {
        let near = |[knot, period]: &&[f64; 2]| {
            let away = (at - knot) - libm::round((at - knot) / period) * period;
            away.abs() <= 64.0 * U * (at.abs() + period)
        };
        match self.knots.iter().find(near) {
            Some([_, period]) => {
                let by = 256.0 * U * (at.abs() + period);
                if after { at + by } else { at - by }
            }
            None => at,
        }
    }

    /// The knots between two angles.
    fn knots_between(&self, from: f64, to: f64) -> Vec<f64> {
        let mut found = Vec::new();
        for [knot, period] in &self.knots {
            let mut at = knot + libm::ceil((from - knot) / period) * period;
            while at < to {
                if at > from {
                    found.push(at);
                }
                at += period;
            }
        }
        found
    }

    fn standing(&self, at: f64) -> Told<Mechanism> {
        (self.standing)(at).ok_or_else(|| undetermined(at))
    }

    /// The torque at an angle.
    pub(super) fn torque(&self, at: f64) -> Told<Known> {
        Self::once(&self.torques, at, || {
            let torque = match self.solved(at) {
                Some(torque) => torque,
                None => {
                    // Where a loaded point turns back its direction is none, and the torque that of either side.
                    let sides = [-BESIDE, BESIDE].map(|step| self.limit(at, step));
                    let [Some(before), Some(after)] = sides else { return Err(undetermined(at)) };
                    let apart = (before.value - after.value).abs();
                    let bound = before.bound + after.bound + apart;
                    Known { value: f64::midpoint(before.value, after.value), bound }
                }
            };
            Ok(Known { value: self.sign * torque.value, ..torque })
        })
    }

    /// Whither the torque goes from one side: its value and its slope, less by a difference of the second order.
    fn limit(&self, at: f64, step: f64) -> Option<Known> {
        let near = [1.0, 2.0, 3.0].map(|steps| self.solved(at + steps * step));
        let [Some(a), Some(b), Some(c)] = near else { return None };
        let slope = b.value - a.value;
        let bend = (c.value - b.value) - slope;
        let bound = 3.0 * (a.bound + b.bound + c.bound) + 2.0 * bend.abs();
        Some(Known { value: a.value - slope, bound })
    }

    /// T(2) by all equations at once.
    fn solved(&self, at: f64) -> Option<Known> {
        let mechanism = (self.standing)(at)?;
        let quantity = Quantity::Force(Force::Torque(0), Share::Total);
        scalar(&solve_for(&mechanism, &[quantity]).ok()?, quantity)
    }

    /// ∫ from 0. Friction has no potential, and what it takes hangs on all that presses: with it the torque itself is
    /// integrated.
    pub(super) fn work(&self, at: f64) -> Told<Known> {
        Self::once(&self.works, at, || {
            if self.rubs {
                let given = self.integral(at)?;
                return Ok(Known { value: -self.sign * given.value, ..given });
            }
            let energy = |at: f64| Self::once(&self.energies, at, || self.energy(at));
            let (from, to) = (energy(0.0)?, energy(at)?);
            let mut work = Known { value: to.value - from.value, bound: to.bound + from.bound };
            if self.works_otherwise {
                let given = self.integral(at)?;
                work = Known { value: work.value - given.value, bound: work.bound + given.bound };
            }
            Ok(Known { value: self.sign * work.value, bound: work.bound + 8.0 * U * work.value.abs() })
        })
    }

    /// What has a potential at an angle: kinetic energy, weights, springs, loads of one size and direction.
    fn energy(&self, at: f64) -> Told<Known> {
        let mechanism = self.standing(at)?;
        let forces = &mechanism.forces;
        let mut quantities = Vec::new();
        for mass in &forces.masses {
            quantities.extend([Quantity::Velocity(mass.centre), Quantity::Position(mass.centre)]);
            quantities.push(Quantity::Omega(mass.link));
            if let Inertia::About(point, _) = mass.inertia {
                quantities.push(Quantity::Position(point));
            }
        }
        for spring in &forces.springs {
            match spring.kind {
                SpringKind::Pull(ends) => {
                    quantities.extend(ends.map(|(_, point)| Quantity::Position(point)));
                }
                SpringKind::Torsion(links) => {
                    let moving = links.into_iter().filter(|link| *link != LinkId::FRAME);
                    quantities.extend(moving.map(Quantity::Angle));
                }
            }
        }
        quantities.extend(forces.loads.iter().filter_map(|load| load.at()).map(Quantity::Position));
        if quantities.is_empty() {
            return Ok(Known { value: 0.0, bound: 0.0 });
        }
        let state = solve_for(&mechanism, &quantities).map_err(|_| undetermined(at))?;
        let mut sum = Sum::default();
        let place =
            |point: PointId| vector(&state, Quantity::Position(point)).ok_or_else(|| undetermined(at));
        for mass in &forces.masses {
            let kilograms = match mass.heaviness {
                Heaviness::Mass(mass) => mass.value,
                Heaviness::Weight(weight) => weight.value / forces.gravity.g.value,
                Heaviness::None => 0.0,
            };
            let (centre, off) = place(mass.centre)?;
            let ([vx, vy], loose) = if mechanism.is_fixed(mass.centre) {
                ([0.0; 2], 0.0)
            } else {
                vector(&state, Quantity::Velocity(mass.centre)).ok_or_else(|| undetermined(at))?
            };
            let speed = libm::hypot(vx, vy);
            sum.add(0.5 * kilograms * speed * speed, kilograms * speed * loose);
            let inertia = match mass.inertia {
                Inertia::Point => 0.0,
                Inertia::Central(inertia) => inertia.value,
                Inertia::Gyration(radius) => kilograms * radius.value * radius.value,
                Inertia::About(point, inertia) => {
                    let (other, _) = place(point)?;
                    let apart = libm::hypot(other[0] - centre[0], other[1] - centre[1]);
                    inertia.value - kilograms * apart * apart
                }
            };
            if inertia != 0.0 {
                let omega = scalar(&state, Quantity::Omega(mass.link)).ok_or_else(|| undetermined(at))?;
                let bound = inertia.abs() * omega.value.abs() * omega.bound;
                sum.add(0.5 * inertia * omega.value * omega.value, bound);
            }
            if forces.gravity.acts {
                let weight = match mass.heaviness {
                    Heaviness::Weight(weight) => weight.value,
                    Heaviness::Mass(mass) => mass.value * forces.gravity.g.value,
                    Heaviness::None => 0.0,
                };
                let (sin, cos) = libm::sincos(forces.gravity.direction.value);
                for (along, place) in [(cos, centre[0]), (sin, centre[1])] {
                    sum.add(-weight * along * place, weight * off);
                }
            }
        }
        for spring in &forces.springs {
            let ends = match spring.kind {
                SpringKind::Pull(ends) => ends,
                SpringKind::Torsion(links) => {
                    let SpringLaw::Stiffness { stiffness: Size::Given(stiffness), free } = spring.law else {
                        // A torque of one size is integrated.
                        continue;
                    };
                    let mut angles = [Known { value: 0.0, bound: 0.0 }; 2];
                    for (angle, link) in angles.iter_mut().zip(links) {
                        if link != LinkId::FRAME {
                            *angle = scalar(&state, Quantity::Angle(link)).ok_or_else(|| undetermined(at))?;
                        }
                    }
                    let [first, second] = angles;
                    let further = second.value - first.value - free.value;
                    let further =
                        further - libm::round(further / std::f64::consts::TAU) * std::f64::consts::TAU;
                    let loose = first.bound + second.bound + 16.0 * U;
                    sum.add(
                        0.5 * stiffness.value * further * further,
                        stiffness.value * further.abs() * loose,
                    );
                    continue;
                }
            };
            let [(one, off), (other, also)] = [place(ends[0].1)?, place(ends[1].1)?];
            let length = libm::hypot(one[0] - other[0], one[1] - other[1]);
            match spring.law {
                SpringLaw::Stiffness { stiffness: Size::Given(stiffness), free } => {
                    let longer = length - free.value;
                    let loose = off + also + U * (length + free.value.abs());
                    sum.add(0.5 * stiffness.value * longer * longer, stiffness.value * longer.abs() * loose);
                }
                SpringLaw::Force(Size::Given(pull)) => {
                    sum.add(pull.value * length, pull.value.abs() * (off + also));
                }
                _ => return Err("a spring is sought".to_owned()),
            }
        }
        for load in &forces.loads {
            let (Some([fx, fy]), Some(point)) = (constant(&load.kind), load.at()) else { continue };
            let (at, off) = place(point)?;
            sum.add(-fx * at[0], fx.abs() * off);
            sum.add(-fy * at[1], fy.abs() * off);
        }
        Ok(Known { value: sum.value, bound: 2.0 * (sum.bound + 32.0 * U * sum.size) })
    }

    /// The mechanism with those loads and springs alone that have no potential, its input at unit speed.
    fn without_potential(&self, at: f64) -> Told<Mechanism> {
        let mut mechanism = self.standing(at)?;
        mechanism.forces.loads.retain(|load| constant(&load.kind).is_none());
        mechanism.forces.masses.clear();
        mechanism.forces.springs.retain(is_a_steady_torque);
        for input in &mut mechanism.inputs {
            if let Input::Angle { omega, .. } = input {
                omega.value = if omega.value < 0.0 { -1.0 } else { 1.0 };
                omega.error = 0.0;
            }
        }
        Ok(mechanism)
    }

    /// Work of the loads without a potential for a radian of the input; with friction what the input gives, reversed. A
    /// load that follows a motion has no direction where that motion rests; its power is the same from either side.
    fn rate(&self, at: f64) -> Told<Known> {
        if self.rubs {
            let torque = self.torque(at)?;
            return Ok(Known { value: -self.sign * torque.value, ..torque });
        }
        if let Some(rate) = self.rate_here(at)? {
            return Ok(Known { value: rate, bound: 0.0 });
        }
        let mut sides = [Known { value: 0.0, bound: 0.0 }; 2];
        for (side, step) in sides.iter_mut().zip([-BESIDE, BESIDE]) {
            let mut near = [0.0; 3];
            for (rate, steps) in near.iter_mut().zip([1.0, 2.0, 3.0]) {
                *rate = self.rate_here(at + steps * step)?.ok_or_else(|| undetermined(at))?;
            }
            let slope = near[1] - near[0];
            let bend = (near[2] - near[1]) - slope;
            *side = Known { value: near[0] - slope, bound: 2.0 * bend.abs() };
        }
        let [before, after] = sides;
        let bound = before.bound + after.bound + (before.value - after.value).abs();
        Ok(Known { value: f64::midpoint(before.value, after.value), bound })
    }

    fn rate_here(&self, at: f64) -> Told<Option<f64>> {
        let mechanism = self.without_potential(at)?;
        let speed = match mechanism.inputs.first() {
            Some(Input::Angle { omega, .. }) => omega.value,
            _ => 1.0,
        };
        let quantity = Quantity::Force(Force::Torque(0), Share::Total);
        let Ok(state) = solve_for(&mechanism, &[quantity]) else { return Ok(None) };
        Ok(state.power().map(|power| (power.loads + power.springs) / speed))
    }

    /// Where a loaded point turns back between two angles: a load against its motion leaps there.
    fn reversals(&self, from: f64, to: f64) -> Told<Vec<f64>> {
        let mechanism = self.without_potential(from)?;
        let mut found = Vec::new();
        for load in mechanism.forces.loads.iter().filter(|load| load.follows_motion()) {
            let quantity = match load.at() {
                Some(point) => Quantity::Velocity(point),
                None => Quantity::Omega(load.link),
            };
            let rate = |at: f64| -> Told<[f64; 2]> {
                let mechanism = self.without_potential(at)?;
                let state = solve_for(&mechanism, &[quantity]).map_err(|_| undetermined(at))?;
                match state.answer(&quantity) {
                    Answer::Vector { value, .. } => Ok(value),
                    Answer::Scalar { value, .. } => Ok([value, 0.0]),
                    _ => Err(undetermined(at)),
                }
            };
            let (start, end) = (rate(from)?, rate(to)?);
            let along = |v: [f64; 2]| v[0] * start[0] + v[1] * start[1];
            if along(end) >= 0.0 {
                continue;
            }
            let (mut low, mut high) = (from, to);
            while high - low > 8.0 * U * (1.0 + high.abs()) {
                let middle = f64::midpoint(low, high);
                if middle <= low || middle >= high {
                    break;
                }
                if along(rate(middle)?) > 0.0 { low = middle } else { high = middle }
            }
            found.push(f64::midpoint(low, high));
        }
        found.sort_by(f64::total_cmp);
        Ok(found)
    }

    fn integral(&self, to: f64) -> Told<Known> {
        let width = std::f64::consts::TAU / f64::from(PIECES);
        let whole = libm::floor(to / width);
        let mut sum = Known { value: 0.0, bound: 0.0 };
        let mut add = |piece: Known, sign: f64| {
            sum.value += sign * piece.value;
            sum.bound += piece.bound;
        };
        let range = if whole >= 0.0 { 0..whole as i64 } else { whole as i64..0 };
        let sign = if whole >= 0.0 { 1.0 } else { -1.0 };
        for index in range {
            let known = self.pieces.borrow().get(&index).copied();
            let piece = match known {
                Some(piece) => piece,
                None => {
                    let piece = self.piece(index as f64 * width, (index + 1) as f64 * width)?;
                    self.pieces.borrow_mut().insert(index, piece);
                    piece
                }
            };
            add(piece, sign);
        }
        add(self.piece(whole * width, to)?, 1.0);
        Ok(sum)
    }

    /// One piece, parted where a load leaps.
    fn piece(&self, from: f64, to: f64) -> Told<Known> {
        if to <= from {
            return Ok(Known { value: 0.0, bound: 0.0 });
        }
        let mut ends = vec![from];
        if self.follows_motion {
            let part = |index: u32| from + (to - from) * f64::from(index) / f64::from(PARTS);
            for index in 0..PARTS {
                ends.extend(self.reversals(part(index), part(index + 1))?);
            }
        }
        ends.extend(self.knots_between(from, to));
        ends.sort_by(f64::total_cmp);
        ends.push(to);
        let mut sum = Known { value: 0.0, bound: 0.0 };
        for pair in ends.windows(2) {
            let part = self.halved(pair[0], pair[1], HALVINGS)?;
            sum = Known { value: sum.value + part.value, bound: sum.bound + part.bound };
        }
        Ok(sum)
    }

    /// What is smooth, in halves where it bends too much for one rule.
    fn halved(&self, from: f64, to: f64, halvings: u32) -> Told<Known> {
        let (whole, coarse) = self.rule(from, to)?;
        if !coarse || halvings == 0 {
            return Ok(whole);
        }
        let middle = f64::midpoint(from, to);
        let [one, other] = [self.halved(from, middle, halvings - 1)?, self.halved(middle, to, halvings - 1)?];
        Ok(Known { value: one.value + other.value, bound: one.bound + other.bound })
    }

    /// An integral by one rule, and whether it is coarse.
    fn rule(&self, from: f64, to: f64) -> Told<(Known, bool)> {
        let (middle, half) = (f64::midpoint(from, to), (to - from) / 2.0);
        if half <= 0.0 {
            return Ok((Known { value: 0.0, bound: 0.0 }, false));
        }
        let (mut fine, mut coarse, mut size, mut loose) = (0.0, 0.0, 0.0, 0.0);
        for (index, node) in NODES.iter().enumerate() {
            let sides: &[f64] = if *node == 0.0 { &[0.0] } else { &[-1.0, 1.0] };
            for side in sides {
                let Known { value, bound } = self.rate(middle + side * node * half)?;
                fine += KRONROD[index] * value;
                loose += KRONROD[index] * bound;
                size += KRONROD[index] * value.abs();
                if index % 2 == 1 {
                    coarse += GAUSS[index / 2] * value;
                }
            }
        }
        // As in QUADPACK: the finer rule errs by far less than the two differ.
        let (apart, size) = ((fine - coarse).abs() * half, size * half);
        let missed =
            if size > 0.0 { size * libm::pow(200.0 * apart / size, 1.5).min(apart / size) } else { 0.0 };
        let whole = Known { value: fine * half, bound: missed + loose * half + 256.0 * U * size };
        Ok((whole, missed > FINE * size))
    }
}

/// Whether the links of every torsion spring have turned back against each other at the end of a period: their angles are
/// followed from place to place.
fn wound_up_as_before(mechanism: &Mechanism, standing: Standing<'_>, period: f64) -> Told<()> {
    for spring in mechanism.springs_that_wind_up() {
        let SpringKind::Torsion([first, second]) = mechanism.forces.springs[spring].kind else { continue };
        let turned = |at: f64| {
            let moved = standing(at)?;
            let moving = [first, second].into_iter().filter(|link| *link != LinkId::FRAME);
            let quantities: Vec<Quantity> = moving.map(Quantity::Angle).collect();
            let state = solve_for(&moved, &quantities).ok()?;
            let angle = |link: LinkId| match link {
                LinkId::FRAME => Some(0.0),
                _ => scalar(&state, Quantity::Angle(link)).map(|known| known.value),
            };
            Some(angle(second)? - angle(first)?)
        };
        let places = (0..=FOLLOWED).map(|step| period * f64::from(step) / f64::from(FOLLOWED));
        let angles: Vec<f64> = places.filter_map(turned).collect();
        let step = |pair: &[f64]| libm::remainder(pair[1] - pair[0], std::f64::consts::TAU);
        let gone: f64 = angles.windows(2).map(step).sum();
        if gone.abs() > std::f64::consts::PI {
            return Err(mechanism.say_wound_up(spring));
        }
    }
    Ok(())
}

fn undetermined(at: f64) -> String {
    format!("the mechanism's torque is not determined at {:.6} deg of its input", at.to_degrees())
}

fn scalar(state: &State, quantity: Quantity) -> Option<Known> {
    match state.answer(&quantity) {
        Answer::Scalar { value, bound } => Some(Known { value, bound }),
        _ => None,
    }
}

fn vector(state: &State, quantity: Quantity) -> Option<([f64; 2], f64)> {
    match state.answer(&quantity) {
        Answer::Vector { value, bound } => Some((value, bound)),
        _ => None,
    }
}

/// Whether a spring is a torque of one size, whose work hangs on how often its links have gone round.
fn is_a_steady_torque(spring: &Spring) -> bool {
    matches!((spring.kind, spring.law), (SpringKind::Torsion(_), SpringLaw::Force(_)))
}

/// The components of a load that is the same in every position.
fn constant(kind: &LoadKind) -> Option<[f64; 2]> {
    match *kind {
        LoadKind::Vector { parts, of: LinkId::FRAME, .. } => Some(parts.map(|part| part.value)),
        LoadKind::Force { size, pointing: Pointing::World(angle), .. } => {
            let newtons = match size {
                Size::Given(force) => force.value,
                Size::Pressure { pressure: Pressure::Given(pressure), area } => {
                    let area = match area {
                        Area::Given(area) => area.value,
                        Area::Bore { bore, rod } => {
                            let square = match rod {
                                Some(rod) => (bore.value - rod.value) * (bore.value + rod.value),
                                None => bore.value * bore.value,
                            };
                            std::f64::consts::FRAC_PI_4 * square
                        }
                    };
                    pressure.value * area
                }
                Size::Sought | Size::Curve(_) | Size::Pressure { .. } => return None,
            };
            let (sin, cos) = libm::sincos(angle.value);
            Some([newtons * cos, newtons * sin])
        }
        LoadKind::Vector { .. } | LoadKind::Force { .. } | LoadKind::Torque { .. } => None,
    }
}

/// A sum with its bound and its size.
#[derive(Default)]
struct Sum {
    value: f64,
    bound: f64,
    size: f64,
}

impl Sum {
    fn add(&mut self, value: f64, bound: f64) {
        self.value += value;
        self.bound += bound;
        self.size += value.abs();
    }
}
