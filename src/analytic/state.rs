//! A solved mechanism, and the bound of a number read off it.

use super::AnalyticError;
use super::assembly::{assemble, by_other_equations};
use super::constraints::{Formulas, Motion, Scope};
use super::cycle::Turning;
use super::figure;
use super::friction::{self, Found, Rubbing};
use super::model::{Model, REPEATED};
use super::motion::{Located, Solved, error_of, locate, param_error, singular_values, solve_motion};
use super::statics::{Balance, Balancing, Burden, balance};
use super::tape::{Leaf, Tape, Var};
use crate::mechanism::force::Share;
use crate::mechanism::friction::RubbingPair;
use crate::mechanism::quantity::{Answer, Indeterminate, Order, Quantity, Stuck};
use crate::mechanism::{Mechanism, Place, PointId};

/// Up to this many unknowns the singular values are those of the whole Jacobian.
const WHOLE: usize = 240;

/// The first-order bound is doubled, for the terms of higher order.
const SAFETY: f64 = 2.0;

/// Rolling bodies come apart that do so by more than this part of how they move.
const PARTING: f64 = 1e-5;

/// So many times as much as usual what repeats given places may miss where a long lever magnifies it: what misses least is
/// tried first.
const PATIENCE: [f64; 3] = [4.0, 16.0, 64.0];

/// A place that is rounded in both coordinates lies so much farther off than what it contradicts is missed by, at most.
const ROUNDED: f64 = 4.0;

/// A point's place with its bound.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spot {
    /// x to the right and y up, metres.
    pub at: [f64; 2],
    /// The true place is no farther away, metres.
    pub bound: f64,
}

/// A mechanism solved at one instant.
#[derive(Debug, Clone)]
pub struct State {
    pub(super) model: Model,
    pub(super) located: Located,
    pub(super) order: Order,
    /// The motion that the inputs drive; `None` where only the position was asked.
    pub(super) solved: Option<Solved>,
    /// The motion under a unit rate of the only input, where that input rests: centres need no speed.
    pub(super) unit: Option<Solved>,
    /// What acts on the bodies; `None` where no force was asked.
    pub(super) burden: Option<Burden>,
    /// The turning-moment diagram, or why there is none; `None` where none was asked.
    pub(super) cycle: Option<Result<Turning, String>>,
    /// The balance of each share that was asked.
    pub(super) balances: Vec<(Share, Balance)>,
    /// The shares in which a rolling contact would have to pull, and why nothing that hangs on it is a force then.
    pub(super) pulls: Vec<(Share, Indeterminate)>,
    /// Why friction, or a load that points nowhere, leaves no force of a pair.
    pub(super) stuck: Option<Indeterminate>,
    /// The bodies at which pairs rub that do not move.
    pub(super) resting: Vec<usize>,
    /// Why some of the quantities were not solved for.
    pub(super) refused: Option<AnalyticError>,
}

/// A number in scaled units with its bound.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Measured {
    pub(super) value: f64,
    pub(super) bound: f64,
}

impl State {
    /// Solves a mechanism up to the given order, its position to `tolerance` where that is coarser than
    /// rounding; only what these quantities depend on, where they are named.
    pub(super) fn new(
        mechanism: &Mechanism,
        order: Order,
        tolerance: f64,
        only: Option<&[Quantity]>,
    ) -> Result<Self, AnalyticError> {
        let standing = figure::standing(mechanism)?;
        let mut shares: Vec<Share> = match only {
            Some(quantities) => quantities.iter().filter_map(share_of).collect(),
            None => Vec::new(),
        };
        let build = |mechanism: &Mechanism| -> Result<(Model, Option<Burden>), AnalyticError> {
            let mut model = Self::compiled(mechanism, order, only)?;
            let burden = if shares.is_empty() { None } else { Some(Burden::new(&mut model)?) };
            // Everything may act on everything: with forces nothing is left out.
            if let (Some(quantities), None) = (only, &burden) {
                model.narrow(quantities, order >= Order::Velocity)?;
            }
            Ok((model, burden))
        };
        let (mut model, mut burden) = build(&standing)?;
        let placed = standing.points.iter().any(|point| matches!(point.place, Place::Placed(_)));
        let mut assembly = match assemble(&model, tolerance, 1.0) {
            Err(error @ AnalyticError::CannotAssemble { .. }) if placed => {
                // Rounded places may contradict by more where a long lever magnifies it, and by no more than that.
                let patient =
                    PATIENCE.into_iter().find_map(|patience| assemble(&model, tolerance, patience).ok());
                let Some(assembly) = patient else { return Err(error) };
                let (rounded, _) = build(&standing.loosened(REPEATED * model.length))?;
                if locate(&rounded, assembly.clone())?.contradiction(&rounded) > 0.0 {
                    return Err(error);
                }
                assembly
            }
            found => found?,
        };
        let mut located = locate(&model, assembly.clone())?;
        if !located.stands_firm() {
            let others = by_other_equations(&model, &assembly, tolerance).into_iter();
            let mut firm = others.filter_map(|other| Some((locate(&model, other.clone()).ok()?, other)));
            if let Some(other) = firm.find(|(located, _)| located.stands_firm()) {
                (located, assembly) = other;
            }
        }
        let missed = if tolerance > 0.0 { 0.0 } else { located.contradiction(&model) };
        if missed > 0.0 {
            // Places that are rounded beside dimensions or guides: as far as they contradict these they may be elsewhere.
            (model, burden) = build(&standing.loosened(ROUNDED * missed * model.length))?;
            located = locate(&model, assembly)?;
        }
        let mut state = Self {
            model,
            located,
            order,
            solved: None,
            unit: None,
            burden,
            cycle: None,
            balances: Vec::new(),
            pulls: Vec::new(),
            stuck: None,
            resting: Vec::new(),
            refused: None,
        };
        if order >= Order::Velocity {
            let (model, located) = (&state.model, &mut state.located);
            let accelerations = order >= Order::Acceleration;
            let solved = solve_motion(model, &model.motion, located, accelerations)?;
            let unit = match &model.unit_motion {
                Some(rows) => Some(solve_motion(model, rows, located, false)?),
                None => None,
            };
            state.solved = Some(solved);
            state.unit = unit;
        }
        if let Some(why) = state.coming_apart()? {
            return Err(AnalyticError::ComesApart { why });
        }
        let unaimed = state.unaimed();
        if let Some(burden) = &mut state.burden {
            unaimed.into_iter().for_each(|(what, why)| burden.leave_out(what, why));
        }
        if let Some(burden) = &state.burden {
            // The balance of powers is that of all that acts.
            shares.push(Share::Total);
            let (mut balances, mut stuck) = (Vec::new(), None);
            for share in [Share::Total, Share::Static, Share::Inertia, Share::Rising, Share::Falling] {
                if shares.contains(&share) {
                    let solved = state.solved.as_ref();
                    let balancing = Balancing::new(&state.model, burden, &state.located, solved, share);
                    let found = if burden.rubbing.is_empty() {
                        balance(&balancing).map(|found| (found, None))
                    } else {
                        state.rubbed(&balancing)
                    };
                    let (found, why) = match found {
                        // Not a fault of the mechanism, but of this position.
                        Err(error @ AnalyticError::Directionless) => {
                            stuck = Some(Indeterminate::Undefined { why: error.to_string() });
                            continue;
                        }
                        found => found?,
                    };
                    stuck = stuck.or(why);
                    balances.push((share, found));
                }
            }
            (state.balances, state.stuck) = (balances, stuck);
            state.pulls = state.pulling();
            state.resting = state.at_rest().into_iter().flat_map(|(bodies, _)| bodies).collect();
        }
        Ok(state)
    }

    /// Why there is no motion, where rolling bodies that nothing holds at their distance come apart: the distance is no
    /// equation of the motion, and its derivatives are not zero.
    fn coming_apart(&self) -> Result<Option<String>, AnalyticError> {
        for roll in 0..self.model.mechanism.rolls.len() {
            if !self.model.rolls_open(roll) {
                continue;
            }
            let row = self.model.distance_row(roll)?;
            let known = [(1, self.solved.as_ref()), (1, self.unit.as_ref()), (2, self.solved.as_ref())];
            for (order, solved) in known.into_iter().take_while(|(order, _)| *order <= self.motion_order()) {
                let Some(solved) = solved else { continue };
                let Ok([rate]) = self.read(order, Some(solved), |s| [s.row(&row).at(order)]) else {
                    continue;
                };
                // Of what moves at all: places that are rounded hold a distance as well as they can.
                let rates = if order == 1 { &solved.rate } else { &solved.accel };
                let bodies = row.bodies();
                let moves = bodies.iter().flat_map(|body| &rates[3 * body..3 * body + 3]);
                let size = moves.fold(0.0_f64, |most, rate| most.max(rate.abs()));
                if rate.value.abs() > (PARTING * size).max(rate.bound) {
                    let second = self.model.time;
                    let (unit, per) = if order == 1 { ("m/s", second) } else { ("m/s^2", second * second) };
                    let si = rate.value.abs() * self.model.length / per;
                    return Ok(Some(self.model.mechanism.say_parts(roll, &format!("{si:.3e} {unit}"))));
                }
            }
        }
        Ok(None)
    }

    /// In which sense a pair that rubs moves: +1, −1, or 0 where it does not.
    fn sense(&self, rubbing: &Rubbing) -> f64 {
        match self.read(1, self.solved.as_ref(), |s| [rubbing.moved(s).d]) {
            Ok([rate]) if rate.value.abs() > rate.bound => rate.value.signum(),
            _ => 0.0,
        }
    }

    /// Whether the sleeve of a governor moves as it is about to, +1, or against that, −1; +1 of whatever moves itself.
    fn sense_of_sleeve(&self, balancing: &Balancing<'_>) -> f64 {
        let wanted = match balancing.share() {
            Share::Rising => 1.0,
            Share::Falling => -1.0,
            Share::Total | Share::Static | Share::Inertia => return 1.0,
        };
        let Some((site, line)) = balancing.burden.sleeve else { return 1.0 };
        match self.read(1, self.solved.as_ref(), |s| [friction::slid(s, site, line).d]) {
            Ok([rate]) if rate.value.abs() > rate.bound => wanted * rate.value.signum(),
            _ => 0.0,
        }
    }

    /// The pairs that rub and do not move, each with its bodies.
    fn at_rest(&self) -> Vec<([usize; 2], RubbingPair)> {
        let rubbing = self.burden.iter().flat_map(|burden| &burden.rubbing);
        let resting = rubbing.filter(|rubbing| self.sense(rubbing) == 0.0);
        resting.map(|rubbing| (rubbing.bodies(), rubbing.pair)).collect()
    }

    /// A balance with friction, and why it leaves nothing where it does.
    fn rubbed(&self, balancing: &Balancing<'_>) -> Result<(Balance, Option<Indeterminate>), AnalyticError> {
        let why = |how: Stuck, why: String| Some(Indeterminate::Rubbing { how, why });
        let round = self.sense_of_sleeve(balancing);
        let senses = balancing.burden.rubbing.iter().map(|rubbing| round * self.sense(rubbing)).collect();
        let at_rest = self.at_rest().into_iter().next();
        let (found, mut balance) = friction::balance(balancing, senses)?;
        if let Some((_, pair)) = at_rest {
            if !matches!(found, Found::One(_) | Found::Singular) {
                balance.undetermined.fill(true);
            }
            return Ok((balance, why(Stuck::AtRest, friction::say_at_rest(&self.model, pair))));
        }
        let stuck = match found {
            Found::One(_) | Found::Singular => None,
            Found::Locked(pairs, part) => why(Stuck::Locked, self.model.mechanism.say_locked(&pairs, part)),
            Found::Several => {
                let pairs: Vec<_> = balancing.burden.rubbing.iter().map(|rubbing| rubbing.pair).collect();
                why(Stuck::Ambiguous, self.model.mechanism.say_several(&pairs))
            }
        };
        Ok((balance, stuck))
    }

    /// Why some of the quantities were not solved for, where it was so: of these there is no answer.
    #[must_use]
    pub fn refused(&self) -> Option<&AnalyticError> {
        self.refused.as_ref()
    }

    /// Why friction leaves no force of a pair, where it does.
    #[must_use]
    pub fn stuck(&self) -> Option<&Indeterminate> {
        self.stuck.as_ref()
    }

    /// A mechanism in a unit of length in which what these quantities depend on can be told apart.
    fn compiled(
        mechanism: &Mechanism,
        order: Order,
        only: Option<&[Quantity]>,
    ) -> Result<Model, AnalyticError> {
        let model = Model::new(mechanism)?;
        let Some(quantities) = only else { return Ok(model) };
        // With forces nothing is left out.
        let forces = quantities.iter().any(|quantity| share_of(quantity).is_some());
        if forces || !model.is_beyond_proportion() {
            return Ok(model);
        }
        let mut narrowed = model.clone();
        narrowed.narrow(quantities, order >= Order::Velocity)?;
        match narrowed.nearer_unit(quantities) {
            Some(unit) => Model::in_unit(mechanism, Some(unit)),
            None => Ok(model),
        }
    }

    /// The highest derivative that is known of the motion.
    pub(super) fn motion_order(&self) -> u8 {
        match &self.solved {
            None => 0,
            Some(solved) if solved.accel.is_empty() => 1,
            Some(_) => 2,
        }
    }

    /// The motion as far as this derivative.
    pub(super) fn motion_here(&self, order: u8) -> Motion<'_> {
        let solved = self.solved.as_ref().filter(|_| order >= 1);
        let (rate, accel): (&[f64], &[f64]) = solved.map_or((&[], &[]), |s| (&s.rate, &s.accel));
        Motion { pose: &self.located.pose, rate, accel, params: &self.model.params }
    }

    /// Place of a point, metres. A fixed or placed point is where the scene puts it.
    ///
    /// # Errors
    /// [`Indeterminate::Undefined`] for a point that is in no link and on no guide,
    /// [`Indeterminate::Singular`] where the position cannot be bounded.
    pub fn pose(&self, point: PointId) -> Result<Spot, Indeterminate> {
        match self.answer(&Quantity::Position(point)) {
            Answer::Vector { value, bound } => Ok(Spot { at: value, bound }),
            Answer::Indeterminate(why) => Err(why),
            Answer::Scalar { .. } | Answer::AtInfinity { .. } => Err(Indeterminate::Singular),
        }
    }

    /// Place of a point without its bound, metres; `None` for a point that is in no link and on no guide, or that was not
    /// solved for.
    #[must_use]
    pub fn seen_at(&self, point: PointId) -> Option<[f64; 2]> {
        self.position_seen(point).ok()
    }

    /// Singular values of the scaled Jacobian, descending: lengths in units near the mechanism's size,
    /// angles in radians. Of the velocity equations where these were asked, else of the position's. Beyond
    /// 240 unknowns they are those of the groups of equations, one by one.
    #[must_use]
    pub fn singular_values(&self) -> Vec<f64> {
        singular_values(self.solved.as_ref().map_or(&self.located.system, |s| &s.system), WHOLE)
    }

    /// Numbers by a formula over the position, without their bounds.
    pub(super) fn glance<const N: usize>(
        &self,
        formula: impl for<'t> Fn(&Scope<'t>) -> [Var<'t>; N],
    ) -> Result<[f64; N], Indeterminate> {
        let tape = Tape::new(0);
        let motion = Motion { pose: &self.located.pose, rate: &[], accel: &[], params: &self.model.params };
        let out = formula(&Scope { tape: &tape, motion }).map(|var| tape.sweep(var).value);
        if tape.broken() {
            return Err(Indeterminate::Undefined { why: "it divides by a length of zero".into() });
        }
        if out.iter().all(|value| value.is_finite()) { Ok(out) } else { Err(Indeterminate::Singular) }
    }

    /// Numbers by a formula over the motion, with their bounds: rounding, residuals and the errors of all
    /// given numbers, each followed through every equation by one sweep back, so that they keep their
    /// correlation. `order` is the highest derivative in the formula.
    pub(super) fn read<const N: usize>(
        &self,
        order: u8,
        solved: Option<&Solved>,
        formula: impl for<'t> Fn(&Scope<'t>) -> [Var<'t>; N],
    ) -> Result<[Measured; N], Indeterminate> {
        let (rate, accel): (&[f64], &[f64]) = match (order, solved) {
            (0, _) => (&[], &[]),
            (_, Some(solved)) => (&solved.rate, &solved.accel),
            (_, None) => return Err(self.not_solved()),
        };
        if order >= 2 && accel.is_empty() {
            return Err(self.not_solved());
        }
        let tape = Tape::new(order);
        let motion = Motion { pose: &self.located.pose, rate, accel, params: &self.model.params };
        let scope = Scope { tape: &tape, motion };
        let out = formula(&scope);
        if tape.broken() {
            return Err(Indeterminate::Undefined { why: "it divides by a length of zero".into() });
        }
        let mut measured = [Measured::default(); N];
        for (slot, var) in measured.iter_mut().zip(out) {
            *slot = self.measure(&tape, var, solved, None)?;
        }
        Ok(measured)
    }

    fn not_solved(&self) -> Indeterminate {
        let solved = match self.order {
            Order::Position => "positions",
            Order::Velocity => "velocities",
            Order::Acceleration => "accelerations",
        };
        Indeterminate::Undefined { why: format!("only {solved} were solved") }
    }

    /// A number on a record with its bound.
    pub(super) fn measure(
        &self,
        tape: &Tape,
        var: Var<'_>,
        solved: Option<&Solved>,
        balance: Option<&Balance>,
    ) -> Result<Measured, Indeterminate> {
        let linear = tape.sweep(var);
        let n = self.model.unknowns();
        let mut gradients = [vec![0.0; n], vec![0.0; n], vec![0.0; n]];
        let mut forces = vec![0.0; balance.map_or(0, |balance| balance.x.len())];
        let mut by_param = vec![0.0; self.model.params.len()];
        for (leaf, c) in &linear.terms {
            match leaf {
                Leaf::Force(at) => forces[*at] += c,
                Leaf::Pose(at) => gradients[0][*at] += c,
                Leaf::Rate(at) => gradients[1][*at] += c,
                Leaf::Accel(at) => gradients[2][*at] += c,
                Leaf::Param(at) => by_param[*at] += c,
            }
        }
        let mut error = linear.rounding;
        if let Some(balance) = balance {
            if forces.iter().zip(&balance.undetermined).any(|(g, lost)| *lost && *g != 0.0) {
                return Err(Indeterminate::Singular);
            }
            let multipliers = balance.system.adjoint(&mut forces);
            error += error_of(&multipliers, &balance.rows, &mut by_param);
            for (row, weight) in &multipliers.rows {
                for (leaf, c) in &balance.rows[*row].terms {
                    match leaf {
                        Leaf::Pose(at) => gradients[0][*at] -= weight * c,
                        Leaf::Rate(at) => gradients[1][*at] -= weight * c,
                        Leaf::Accel(at) => gradients[2][*at] -= weight * c,
                        Leaf::Param(_) | Leaf::Force(_) => {}
                    }
                }
            }
        }
        let [mut poses, mut rates, mut accels] = gradients;
        if let Some(solved) = solved {
            let lost = |gradient: &[f64]| {
                gradient.iter().zip(&solved.undetermined).any(|(g, undetermined)| *undetermined && *g != 0.0)
            };
            let flat = linear.flat.iter().any(|leaf| match leaf {
                Leaf::Rate(at) | Leaf::Accel(at) => solved.undetermined[*at],
                Leaf::Pose(_) | Leaf::Param(_) | Leaf::Force(_) => false,
            });
            if lost(&rates) || lost(&accels) || flat {
                return Err(Indeterminate::Singular);
            }
            let multipliers = solved.system.adjoint(&mut accels);
            error += error_of(&multipliers, &solved.acceleration_rows, &mut by_param);
            for (row, weight) in &multipliers.rows {
                for (leaf, c) in &solved.acceleration_rows[*row].terms {
                    match leaf {
                        Leaf::Pose(at) => poses[*at] -= weight * c,
                        Leaf::Rate(at) => rates[*at] -= weight * c,
                        Leaf::Accel(_) | Leaf::Param(_) | Leaf::Force(_) => {}
                    }
                }
            }
            let multipliers = solved.system.adjoint(&mut rates);
            error += error_of(&multipliers, &solved.velocity_rows, &mut by_param);
            for (row, weight) in &multipliers.rows {
                for (leaf, c) in &solved.velocity_rows[*row].terms {
                    if let Leaf::Pose(at) = leaf {
                        poses[*at] -= weight * c;
                    }
                }
            }
        }
        let multipliers = self.located.system.adjoint(&mut poses);
        error += error_of(&multipliers, &self.located.rows, &mut by_param);
        error += param_error(&by_param, &self.model.params);
        let bound = SAFETY * error;
        if linear.value.is_finite() && bound.is_finite() {
            Ok(Measured { value: linear.value, bound })
        } else {
            Err(Indeterminate::Singular)
        }
    }
}

/// The share of a force.
fn share_of(quantity: &Quantity) -> Option<Share> {
    match quantity {
        Quantity::Force(_, share) => Some(*share),
        _ => None,
    }
}
