//! Errors of the position, and the linear systems of velocities and accelerations.
//!
//! With the constraints `F(q, t) = 0` the motion follows from `J q̇ = −∂F/∂t` and `J q̈ = −(J̇ q̇ + …)`,
//! both solved from the same Jacobian and refined on the residual of the full equations.

use nalgebra::DMatrix;

use super::AnalyticError;
use super::assembly::{Assembly, tolerance};
use super::constraints::{Motion, Param, Row};
use super::linear::{Multipliers, System, entry_error};
use super::model::Model;
use super::ordering::{Ordering, order};
use super::sketch::{self, Draws, Source, draws_of};
use super::tape::{Leaf, Linear, U};

/// Rounds of iterative refinement at most.
const REFINEMENTS: usize = 3;
/// A correction of so many units of rounding of what it corrects, of each unknown, is no more than the noise of the
/// residual that it follows from. Bounds are those of the residual that is left.
const NOISE: f64 = 4.0;
/// Largest relative contradiction of a redundant equation of motion.
const CONTRADICTION: f64 = 1e-6;
/// Radii that are carried on from group to group lose the correlations of their errors, and grow along a chain. As long
/// as they are below this (in mechanism sizes and radians) they serve to tell that a group is regular; then the radii
/// of one group are sketched, and carried on from there.
const ROUGH: f64 = 1e-8;
/// Radius of a pose of which nothing is known; its products stay finite.
const UNBOUNDED: f64 = 1e150;
/// The first-order bound of what an equation may miss by is doubled for what it leaves out.
const OPEN: f64 = 2.0;
/// A second singular value below this leaves the width of a singular position unknown.
const DOUBLY_SINGULAR: f64 = 1e-5;

/// The position with the radii of all poses.
#[derive(Debug, Clone)]
pub(super) struct Located {
    /// Poses, scaled.
    pub(super) pose: Vec<f64>,
    /// The equations at the position.
    pub(super) rows: Vec<Linear>,
    /// Their Jacobian.
    pub(super) system: System,
    /// First-order radius of each pose coordinate, or more.
    pub(super) error: Vec<f64>,
    /// How they were found.
    sharp: Vec<Sharpness>,
    /// Draws of what each pose coordinate errs by, of those found in the first groups.
    sketches: Vec<Draws>,
    /// How many groups these are.
    sketched: usize,
    /// Room for a motion: of nothing, whenever nobody uses it.
    rest: Vec<f64>,
}

/// A motion.
#[derive(Debug, Clone)]
pub(super) struct Solved {
    /// First derivatives of the poses.
    pub(super) rate: Vec<f64>,
    /// Second derivatives; empty where only velocities were asked.
    pub(super) accel: Vec<f64>,
    /// The velocity equations at the motion.
    pub(super) velocity_rows: Vec<Linear>,
    /// The acceleration equations at the motion.
    pub(super) acceleration_rows: Vec<Linear>,
    /// Their Jacobian.
    pub(super) system: System,
    /// Unknowns that are not determined here.
    pub(super) undetermined: Vec<bool>,
}

/// How the radius of a pose coordinate was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Sharpness {
    /// Carried on from the group before, without correlations.
    Carried,
    /// Sketched: by correlations, and coarse.
    Sketched,
    /// By a sweep back through all equations: it is no more than it has to be.
    Whole,
}

fn no_value() -> AnalyticError {
    AnalyticError::Malformed { what: "an equation divides by zero".into() }
}

/// Error of a number from its multipliers: what the residuals, their rounding and the parameters make of
/// it, to first order.
pub(super) fn error_of(multipliers: &Multipliers, rows: &[Linear], by_param: &mut [f64]) -> f64 {
    let mut error = multipliers.slack;
    for (row, weight) in &multipliers.rows {
        let linear = &rows[*row];
        error += weight.abs() * (linear.value.abs() + linear.rounding);
        for (leaf, c) in &linear.terms {
            if let Leaf::Param(at) = leaf {
                by_param[*at] -= weight * c;
            }
        }
    }
    error
}

/// What the parameters' errors make of a number.
pub(super) fn param_error(by_param: &[f64], params: &[Param]) -> f64 {
    by_param.iter().zip(params).map(|(c, p)| c.abs() * p.error).filter(|e| *e > 0.0).sum()
}

/// The radii of an assembled position.
pub(super) fn locate(model: &Model, assembly: Assembly) -> Result<Located, AnalyticError> {
    let Assembly { pose, ordering } = assembly;
    let motion = Motion { pose: &pose, rate: &[], accel: &[], params: &model.params };
    let rows: Vec<Linear> = model
        .position
        .iter()
        .map(|row| row.linear(motion, 0).ok_or_else(no_value))
        .collect::<Result<_, _>>()?;
    let n = model.unknowns();
    let system = System::new(ordering.groups, &rows, n, |leaf| match leaf {
        Leaf::Pose(at) => Some(at),
        _ => None,
    });
    let mut located = Located {
        error: vec![0.0; n],
        sharp: vec![Sharpness::Carried; n],
        sketches: Vec::new(),
        sketched: 0,
        rest: vec![0.0; n],
        pose,
        rows,
        system,
    };
    for index in 0..located.system.blocks.len() {
        located.judge(model, index);
    }
    Ok(located)
}

impl Located {
    /// Whether every group of equations determines its unknowns.
    pub(super) fn stands_firm(&self) -> bool {
        self.system.blocks.iter().all(|block| block.inverse.is_some())
    }

    /// By how much the worst of the equations misses that were not needed to find the position, beyond what the given numbers
    /// leave open of it.
    pub(super) fn contradiction(&self, model: &Model) -> f64 {
        let mut used = vec![false; model.position.len()];
        for row in self.system.blocks.iter().flat_map(|block| &block.group.rows) {
            used[*row] = true;
        }
        let spare = model.position.iter().zip(used).filter(|(_, used)| !used).map(|(row, _)| row);
        let motion = Motion { pose: &self.pose, rate: &[], accel: &[], params: &model.params };
        let beyond = |row: &Row| -> Option<f64> {
            let linear = row.linear(motion, 0)?;
            if linear.value.abs() <= tolerance(model, &linear) {
                return Some(0.0);
            }
            let mut gradient = vec![0.0; self.pose.len()];
            let mut by_param = vec![0.0; model.params.len()];
            for (leaf, c) in &linear.terms {
                match leaf {
                    Leaf::Pose(at) => gradient[*at] += c,
                    Leaf::Param(at) => by_param[*at] += c,
                    Leaf::Rate(_) | Leaf::Accel(_) | Leaf::Force(_) => {}
                }
            }
            let multipliers = self.system.adjoint(&mut gradient);
            let open = linear.rounding + error_of(&multipliers, &self.rows, &mut by_param);
            Some((linear.value.abs() - OPEN * (open + param_error(&by_param, &model.params))).max(0.0))
        };
        spare.chain(&model.repeated).filter_map(beyond).fold(0.0, f64::max)
    }

    /// Radii of one group's unknowns, and whether the group is regular.
    fn judge(&mut self, model: &Model, index: usize) {
        let columns = self.system.blocks[index].group.columns.clone();
        if self.system.blocks[index].inverse.is_some() {
            self.carry_on(model, index);
            if columns.iter().any(|column| self.error[*column] > ROUGH) {
                self.sharpen(model, columns.iter().copied(), Sharpness::Sketched);
            }
            let Self { pose, error, rest, system, .. } = self;
            let regular = looks_regular(system, index, &model.position, model, pose, error, rest);
            if regular || self.is_regular_when_sharp(model, index) {
                return;
            }
        }
        let widths = self.widths(model, index);
        for (k, column) in columns.iter().enumerate() {
            self.error[*column] = widths.as_ref().map_or(UNBOUNDED, |w| w[k]);
            self.sharp[*column] = Sharpness::Whole;
        }
        self.system.blocks[index].inverse = None;
        self.system.blocks[index].widths = widths;
        // A sketch of it as a regular one does not hold.
        self.sketched = self.sketched.min(index);
    }

    /// Radii of one group's unknowns from those of the unknowns before it, as if these erred independently.
    fn carry_on(&mut self, model: &Model, index: usize) {
        let block = &self.system.blocks[index];
        let columns = &block.group.columns;
        let open: Vec<f64> = block.group.rows.iter().map(|row| self.open(model, *row, columns)).collect();
        for (k, column) in columns.iter().enumerate() {
            let moved = |inverse: &DMatrix<f64>| {
                open.iter().enumerate().map(|(i, open)| inverse[(k, i)].abs() * open).sum()
            };
            self.error[*column] = block.inverse.as_ref().map_or(UNBOUNDED, moved);
        }
    }

    /// How far an equation is from holding, as far as it does not hang on these unknowns.
    fn open(&self, model: &Model, row: usize, columns: &[usize]) -> f64 {
        let linear = &self.rows[row];
        let spread: f64 = linear
            .terms
            .iter()
            .map(|(leaf, c)| match leaf {
                Leaf::Param(at) => c.abs() * model.params[*at].error,
                Leaf::Pose(at) if columns.binary_search(at).is_err() => c.abs() * self.error[*at],
                _ => 0.0,
            })
            .sum();
        linear.value.abs() + linear.rounding + spread
    }

    /// Finds the radii of these unknowns. Says whether any was not found so before.
    fn sharpen(&mut self, model: &Model, columns: impl Iterator<Item = usize>, how: Sharpness) -> bool {
        let rough: Vec<usize> = columns.filter(|column| self.sharp[*column] < how).collect();
        if how == Sharpness::Sketched {
            for &column in &rough {
                self.error[column] = self.error[column].min(self.sketched_error(model, column));
                self.sharp[column] = how;
            }
            return !rough.is_empty();
        }
        let mut gradient = vec![0.0; if rough.is_empty() { 0 } else { self.pose.len() }];
        for &column in &rough {
            gradient[column] = 1.0;
            let multipliers = self.system.adjoint(&mut gradient);
            let mut by_param = vec![0.0; model.params.len()];
            let error = error_of(&multipliers, &self.rows, &mut by_param);
            self.error[column] = self.error[column].min(error + param_error(&by_param, &model.params));
            self.sharp[column] = how;
            // What nothing moves keeps its gradient.
            gradient[column] = 0.0;
        }
        !rough.is_empty()
    }

    /// The radius of an unknown as its sketch tells it.
    fn sketched_error(&mut self, model: &Model, column: usize) -> f64 {
        let Some(block) = self.system.block_of(column) else { return 0.0 };
        self.sketches.resize(self.pose.len(), Draws::default());
        for index in self.sketched..=block {
            self.sketch(model, index);
        }
        self.sketched = self.sketched.max(block + 1);
        sketch::size(&self.sketches[column])
    }

    /// Sketches a group, those before it being sketched.
    fn sketch(&mut self, model: &Model, index: usize) {
        let block = &self.system.blocks[index];
        let columns = &block.group.columns;
        let missed_by = |row: &usize| {
            let linear = &self.rows[*row];
            let mut missed = Draws::default();
            sketch::add(&mut missed, linear.value.abs() + linear.rounding, &draws_of(Source::Row(*row)));
            for (leaf, c) in &linear.terms {
                match leaf {
                    Leaf::Param(at) => {
                        let error = model.params[*at].error;
                        if error != 0.0 {
                            sketch::add(&mut missed, c * error, &draws_of(Source::Param(*at)));
                        }
                    }
                    Leaf::Pose(at) if columns.binary_search(at).is_err() => {
                        sketch::add(&mut missed, *c, &self.sketches[*at]);
                    }
                    _ => {}
                }
            }
            missed
        };
        let found: Vec<Draws> = match (&block.inverse, &block.widths) {
            (Some(inverse), _) => {
                let missed: Vec<Draws> = block.group.rows.iter().map(missed_by).collect();
                let moved = |k: usize| {
                    let mut moved = Draws::default();
                    for (i, missed) in missed.iter().enumerate() {
                        sketch::add(&mut moved, inverse[(k, i)], missed);
                    }
                    moved
                };
                (0..columns.len()).map(moved).collect()
            }
            (None, Some(widths)) => {
                let of_width = |(column, width): (&usize, &f64)| {
                    let mut moved = Draws::default();
                    sketch::add(&mut moved, *width, &draws_of(Source::Width(*column)));
                    moved
                };
                columns.iter().zip(widths).map(of_width).collect()
            }
            (None, None) => vec![[f64::INFINITY; sketch::DRAWS]; columns.len()],
        };
        for (column, draws) in columns.iter().zip(found) {
            self.sketches[*column] = draws;
        }
    }

    /// Finds the radii on which equations hang.
    fn sharpen_for(&mut self, model: &Model, equations: &[Row], rows: &[usize], how: Sharpness) -> bool {
        let mut bodies: Vec<usize> = rows.iter().flat_map(|row| equations[*row].all_bodies()).collect();
        bodies.sort_unstable();
        bodies.dedup();
        self.sharpen(model, bodies.into_iter().flat_map(|body| 3 * body..3 * body + 3), how)
    }

    /// Whether a group of the position that did not look regular is so when all radii are as small as they are.
    fn is_regular_when_sharp(&mut self, model: &Model, index: usize) -> bool {
        let rows = self.system.blocks[index].group.rows.clone();
        [Sharpness::Sketched, Sharpness::Whole].into_iter().any(|how| {
            self.sharpen_for(model, &model.position, &rows, how) && {
                let Self { pose, error, rest, system, .. } = self;
                looks_regular(system, index, &model.position, model, pose, error, rest)
            }
        })
    }

    /// Whether a group of the motion is regular.
    fn is_regular(&mut self, model: &Model, equations: &[Row], system: &System, index: usize) -> bool {
        let looks = |at: &mut Self| {
            let Self { pose, error, rest, .. } = at;
            looks_regular(system, index, equations, model, pose, error, rest)
        };
        let rows = &system.blocks[index].group.rows;
        looks(self)
            || [Sharpness::Sketched, Sharpness::Whole]
                .into_iter()
                .any(|how| self.sharpen_for(model, equations, rows, how) && looks(self))
    }

    /// At a dead centre of the position itself the equations fix the singular direction v only to second
    /// order, ½ h δ² ≤ residual: the radius is of the order of the root of the rounding.
    fn widths(&self, model: &Model, index: usize) -> Option<Vec<f64>> {
        let block = &self.system.blocks[index];
        let columns = &block.group.columns;
        let n = columns.len();
        let svd = block.jacobian.clone().svd(true, true);
        let (u, v_t) = (svd.u?, svd.v_t?);
        let last = (0..n).min_by(|a, b| svd.singular_values[*a].total_cmp(&svd.singular_values[*b]))?;

        let open: Vec<f64> = block.group.rows.iter().map(|row| self.open(model, *row, columns)).collect();
        // Second difference of the equations along v.
        let step = 1e-3;
        let bent = |sign: f64| -> Option<Vec<f64>> {
            let mut pose = self.pose.clone();
            for (k, column) in columns.iter().enumerate() {
                pose[*column] += sign * step * v_t[(last, k)];
            }
            let motion = Motion { pose: &pose, rate: &[], accel: &[], params: &model.params };
            let rows = block.group.rows.iter();
            rows.map(|row| model.position[*row].linear(motion, 0).map(|l| l.value)).collect()
        };
        let (ahead, behind) = (bent(1.0)?, bent(-1.0)?);
        let curvature: Vec<f64> = (0..n)
            .map(|i| {
                let here = self.rows[block.group.rows[i]].value;
                (ahead[i] + behind[i] - 2.0 * here) / (step * step)
            })
            .collect();
        let along =
            |k: usize, values: &[f64]| -> f64 { (0..n).map(|i| u[(i, k)] * values[i]).sum::<f64>().abs() };
        let within = |k: usize| -> f64 { (0..n).map(|i| u[(i, k)].abs() * open[i]).sum() };
        let bend = along(last, &curvature);
        if bend.is_nan() || bend <= DOUBLY_SINGULAR {
            return None;
        }
        let width = 2.0 * (2.0 * svd.singular_values[last] / bend + (2.0 * within(last) / bend).sqrt());
        let mut widths: Vec<f64> = (0..n).map(|j| width * v_t[(last, j)].abs()).collect();
        for k in (0..n).filter(|k| *k != last) {
            let sigma = svd.singular_values[k];
            if sigma < DOUBLY_SINGULAR {
                return None;
            }
            let shift = (within(k) + 0.5 * along(k, &curvature) * width * width) / sigma;
            for (j, w) in widths.iter_mut().enumerate() {
                *w += shift * v_t[(k, j)].abs();
            }
        }
        Some(widths)
    }
}

/// Whether a group of these equations is regular within these radii of the pose.
fn looks_regular(
    system: &System,
    index: usize,
    equations: &[Row],
    model: &Model,
    pose: &[f64],
    error: &[f64],
    rest: &mut [f64],
) -> bool {
    system.is_regular(index, |row, column| {
        entry_error(&equations[row], pose, error, &model.params, column, rest)
    })
}

/// Solves the velocities and, where asked, the accelerations.
pub(super) fn solve_motion(
    model: &Model,
    equations: &[Row],
    located: &mut Located,
    accelerations: bool,
) -> Result<Solved, AnalyticError> {
    let n = model.unknowns();
    let rest = vec![0.0; n];
    let evaluate = |located: &Located, rate: &[f64], accel: &[f64], order: u8| -> Result<Vec<Linear>, _> {
        let motion = Motion { pose: &located.pose, rate, accel, params: &model.params };
        equations.iter().map(|row| row.linear(motion, order).ok_or_else(no_value)).collect()
    };
    let residuals = |linears: &[Linear]| -> Vec<f64> { linears.iter().map(|l| -l.value).collect() };

    let Ordering { groups, free, spare } = order(&model.pattern_of_motion(equations)?, n);
    let at_rest = evaluate(located, &rest, &[], 1)?;
    let mut system = System::new(groups, &at_rest, n, |leaf| match leaf {
        Leaf::Rate(at) => Some(at),
        _ => None,
    });
    let mut undetermined = vec![false; n];
    for column in free.iter().filter(|c| **c >= 3) {
        undetermined[*column] = true;
    }
    for index in 0..system.blocks.len() {
        let regular = located.is_regular(model, equations, &system, index);
        if !regular {
            system.blocks[index].inverse = None;
        }
        if !regular || system.uses(index, &undetermined) {
            for column in &system.blocks[index].group.columns {
                undetermined[*column] = true;
            }
        }
    }

    let located = &*located;
    let evaluate = |rate: &[f64], accel: &[f64], order: u8| evaluate(located, rate, accel, order);
    // Solves the equations of `linears`, which are those at x, and refines; returns the equations at what x has become.
    type Equations = Result<Vec<Linear>, AnalyticError>;
    let refine =
        |x: &mut Vec<f64>, mut linears: Vec<Linear>, at: &dyn Fn(&[f64]) -> Equations| -> Equations {
            let mut last = f64::INFINITY;
            for _ in 0..=REFINEMENTS {
                let correction = system.solve(&residuals(&linears), &undetermined);
                let parts =
                    x.iter().zip(&correction).filter(|(_, d)| **d != 0.0).map(|(x, d)| d.abs() / x.abs());
                let part = parts.fold(0.0, f64::max);
                // Where it does not become less it is noise as well.
                if part <= NOISE * U || part > 0.25 * last {
                    break;
                }
                last = part;
                for (x, d) in x.iter_mut().zip(correction) {
                    *x += d;
                }
                linears = at(x)?;
            }
            Ok(linears)
        };
    let mut rate = rest.clone();
    let velocity_rows = refine(&mut rate, at_rest, &|rate| evaluate(rate, &[], 1))?;
    let mut accel = Vec::new();
    let mut acceleration_rows = Vec::new();
    if accelerations {
        accel = rest;
        let at_rest = evaluate(&rate, &accel, 2)?;
        acceleration_rows = refine(&mut accel, at_rest, &|accel| evaluate(&rate, accel, 2))?;
    }
    let fastest = rate.iter().fold(0.0_f64, |most, r| most.max(r.abs()));
    for row in &spare {
        let determined = system.entries[*row].iter().all(|(c, _)| !undetermined[*c]);
        if determined && velocity_rows[*row].value.abs() > CONTRADICTION * fastest {
            return Err(AnalyticError::Contradictory);
        }
    }
    Ok(Solved { rate, accel, velocity_rows, acceleration_rows, system, undetermined })
}

/// Singular values of a system, descending: of the whole Jacobian up to `most` unknowns, of its groups
/// one by one beyond.
pub(super) fn singular_values(system: &System, most: usize) -> Vec<f64> {
    let columns: Vec<usize> = system.blocks.iter().flat_map(|b| b.group.columns.iter().copied()).collect();
    let mut values: Vec<f64> = if columns.len() <= most {
        let rows = system.blocks.iter().flat_map(|b| b.group.rows.iter());
        let mut jacobian = DMatrix::zeros(columns.len(), columns.len());
        for (i, row) in rows.enumerate() {
            for (column, value) in &system.entries[*row] {
                if let Some(j) = columns.iter().position(|c| c == column) {
                    jacobian[(i, j)] = *value;
                }
            }
        }
        jacobian.singular_values().iter().copied().collect()
    } else {
        let blocks = system.blocks.iter();
        blocks.flat_map(|b| b.jacobian.singular_values().iter().copied().collect::<Vec<_>>()).collect()
    };
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

#[cfg(test)]
impl Located {
    /// How many radii took a sweep back through all equations.
    pub(super) fn swept(&self) -> usize {
        self.sharp.iter().filter(|how| **how == Sharpness::Whole).count()
    }

    /// The radius of every coordinate, as a sketch tells it and as a sweep back does.
    pub(super) fn sketched_and_swept(&mut self, model: &Model) -> Vec<[f64; 2]> {
        let n = self.pose.len();
        let sketched: Vec<f64> = (3..n).map(|column| self.sketched_error(model, column)).collect();
        self.sharp.fill(Sharpness::Carried);
        self.error.fill(f64::INFINITY);
        self.sharpen(model, 3..n, Sharpness::Whole);
        sketched.into_iter().zip(&self.error[3..]).map(|(sketched, swept)| [sketched, *swept]).collect()
    }
}
