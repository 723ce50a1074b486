//! Block-triangular linear systems: solved group by group, forwards for motions and backwards for the
//! sensitivities of one number to every equation.

use nalgebra::DMatrix;

use super::constraints::{Motion, Param, Row};
use super::ordering::Group;
use super::tape::{Leaf, Linear, U};

/// A singular direction counts as singular where the first-order error of the Jacobian passes this part
/// of it.
const SINGULAR: f64 = 1.0 / 8.0;
/// Radius of an entry that is one by its form, in units of rounding.
const PLAIN: f64 = 8.0;

/// One group with its inverse.
#[derive(Debug, Clone)]
pub(super) struct Block {
    /// Its equations and unknowns.
    pub(super) group: Group,
    /// The Jacobian of the group.
    pub(super) jacobian: DMatrix<f64>,
    /// Its inverse; `None` where it is singular within its error.
    pub(super) inverse: Option<DMatrix<f64>>,
    /// Radius of each unknown where the group is singular and only the position is asked; `None` where
    /// nothing is known.
    pub(super) widths: Option<Vec<f64>>,
}

/// A system of equations linear in all unknowns.
#[derive(Debug, Clone)]
pub(super) struct System {
    /// The nonzero entries of each equation.
    pub(super) entries: Vec<Vec<(usize, f64)>>,
    /// The groups in their order of solution.
    pub(super) blocks: Vec<Block>,
    /// The block of each unknown.
    block_of: Vec<usize>,
}

/// What one number feels of the equations.
#[derive(Debug, Clone, Default)]
pub(super) struct Multipliers {
    /// Change of the number per residual, by equation.
    pub(super) rows: Vec<(usize, f64)>,
    /// What singular groups add to its error.
    pub(super) slack: f64,
}

impl System {
    /// A system with its groups; the entries are those of leaf kind `unknown`.
    pub(super) fn new(
        groups: Vec<Group>,
        linears: &[Linear],
        unknowns: usize,
        unknown: impl Fn(Leaf) -> Option<usize>,
    ) -> Self {
        let entries: Vec<Vec<(usize, f64)>> = linears
            .iter()
            .map(|l| l.terms.iter().filter_map(|(leaf, c)| Some((unknown(*leaf)?, *c))).collect())
            .collect();
        let mut block_of = vec![usize::MAX; unknowns];
        let blocks = groups
            .into_iter()
            .enumerate()
            .map(|(index, group)| {
                for column in &group.columns {
                    block_of[*column] = index;
                }
                let n = group.columns.len();
                let mut jacobian = DMatrix::zeros(n, n);
                for (i, row) in group.rows.iter().enumerate() {
                    for (column, value) in &entries[*row] {
                        if let Ok(j) = group.columns.binary_search(column) {
                            jacobian[(i, j)] = *value;
                        }
                    }
                }
                let inverse = invert(&jacobian);
                Block { group, jacobian, inverse, widths: None }
            })
            .collect();
        Self { entries, blocks, block_of }
    }

    /// Whether a row of the block uses one of the marked unknowns.
    pub(super) fn uses(&self, block: usize, marked: &[bool]) -> bool {
        self.blocks[block]
            .group
            .rows
            .iter()
            .any(|row| self.entries[*row].iter().any(|(column, value)| *value != 0.0 && marked[*column]))
    }

    /// Solves `J x = rhs`; unknowns of singular groups, and those that nothing determines, stay zero.
    pub(super) fn solve(&self, rhs: &[f64], undetermined: &[bool]) -> Vec<f64> {
        let mut x = vec![0.0; self.block_of.len()];
        for (index, block) in self.blocks.iter().enumerate() {
            let Some(inverse) = &block.inverse else { continue };
            if block.group.columns.iter().any(|c| undetermined[*c]) {
                continue;
            }
            let local: Vec<f64> = block
                .group
                .rows
                .iter()
                .map(|row| {
                    let known = self.entries[*row].iter().filter(|(c, _)| self.block_of[*c] != index);
                    rhs[*row] - known.map(|(c, value)| value * x[*c]).sum::<f64>()
                })
                .collect();
            for (i, column) in block.group.columns.iter().enumerate() {
                x[*column] = (0..local.len()).map(|k| inverse[(i, k)] * local[k]).sum();
            }
        }
        x
    }

    /// By how much each unknown moves at most where each equation is off by so much; those of singular groups stay zero.
    pub(super) fn moved_by(&self, off: &[f64]) -> Vec<f64> {
        let mut moved = vec![0.0; self.block_of.len()];
        for (index, block) in self.blocks.iter().enumerate() {
            let Some(inverse) = &block.inverse else { continue };
            let of_row = |row: &usize| {
                let known = self.entries[*row].iter().filter(|(c, _)| self.block_of[*c] != index);
                off[*row] + known.map(|(c, value)| value.abs() * moved[*c]).sum::<f64>()
            };
            let local: Vec<f64> = block.group.rows.iter().map(of_row).collect();
            for (i, column) in block.group.columns.iter().enumerate() {
                moved[*column] = (0..local.len()).map(|k| inverse[(i, k)].abs() * local[k]).sum();
            }
        }
        moved
    }

    /// The block in which an unknown is found; none for what does not move.
    pub(super) fn block_of(&self, column: usize) -> Option<usize> {
        self.block_of.get(column).copied().filter(|block| *block != usize::MAX)
    }

    /// The multipliers of a number whose gradient towards the unknowns is `gradient`: one sweep back, of which no gradient is
    /// left.
    pub(super) fn adjoint(&self, gradient: &mut [f64]) -> Multipliers {
        let mut multipliers = Multipliers { rows: Vec::new(), slack: 0.0 };
        let moves =
            gradient.iter().zip(&self.block_of).filter(|(g, block)| **g != 0.0 && **block != usize::MAX);
        let Some(last) = moves.map(|(_, block)| *block).max() else { return multipliers };
        // Blocks depend on earlier ones.
        for index in (0..=last).rev() {
            let block = &self.blocks[index];
            let columns = &block.group.columns;
            if columns.iter().all(|c| gradient[*c] == 0.0) {
                continue;
            }
            if let Some(inverse) = &block.inverse {
                for (i, row) in block.group.rows.iter().enumerate() {
                    let weight: f64 =
                        columns.iter().enumerate().map(|(j, c)| inverse[(j, i)] * gradient[*c]).sum();
                    if weight == 0.0 {
                        continue;
                    }
                    multipliers.rows.push((*row, weight));
                    for (column, value) in &self.entries[*row] {
                        let before = self.block_of[*column];
                        if before != index && before != usize::MAX {
                            gradient[*column] -= weight * value;
                        }
                    }
                }
            } else {
                multipliers.slack += match &block.widths {
                    Some(widths) => columns.iter().zip(widths).map(|(c, w)| gradient[*c].abs() * w).sum(),
                    None => f64::INFINITY,
                };
            }
            columns.iter().for_each(|column| gradient[*column] = 0.0);
        }
        multipliers
    }

    /// Whether the Jacobian of a block is regular, whatever its error makes of it. `error(row, column)`
    /// is the first-order radius of an entry.
    pub(super) fn is_regular(&self, block: usize, mut error: impl FnMut(usize, usize) -> f64) -> bool {
        let block = &self.blocks[block];
        let Some(inverse) = &block.inverse else { return false };
        let n = block.group.columns.len();
        if let ([only], [row], [column]) =
            (inverse.as_slice(), block.group.rows.as_slice(), block.group.columns.as_slice())
        {
            // NaN is not regular.
            return only.abs() * error(*row, *column) <= SINGULAR;
        }
        let errors = DMatrix::from_fn(n, n, |i, j| error(block.group.rows[i], block.group.columns[j]));
        let product = inverse.map(f64::abs) * errors;
        spectral_radius_bound(&product) <= SINGULAR
    }
}

/// The inverse, where there is one.
fn invert(matrix: &DMatrix<f64>) -> Option<DMatrix<f64>> {
    if let [only] = matrix.as_slice() {
        let inverse = 1.0 / only;
        return inverse.is_finite().then(|| DMatrix::from_element(1, 1, inverse));
    }
    matrix.clone().lu().try_inverse().filter(|m| m.iter().all(|x| x.is_finite()))
}

/// An upper bound of the spectral radius of a nonnegative matrix: max (Mx)ᵢ/xᵢ for any positive x
/// (Collatz 1942, Wielandt 1950). It does not depend on the scales of the unknowns.
fn spectral_radius_bound(matrix: &DMatrix<f64>) -> f64 {
    let n = matrix.nrows();
    if !matrix.iter().all(|m| m.is_finite()) {
        return f64::INFINITY;
    }
    let mut x = vec![1.0; n];
    let mut best = f64::INFINITY;
    for _ in 0..40 {
        let product: Vec<f64> = (0..n).map(|i| (0..n).map(|j| matrix[(i, j)] * x[j]).sum()).collect();
        let ratio = product.iter().zip(&x).map(|(p, x)| p / x).fold(0.0, f64::max);
        if ratio.is_nan() {
            return f64::INFINITY;
        }
        best = best.min(ratio);
        if best <= SINGULAR || !ratio.is_finite() {
            break;
        }
        // Iterate with M + sI, which keeps x positive.
        let shift = 0.1 * ratio;
        let next: Vec<f64> = product.iter().zip(&x).map(|(p, x)| p + shift * x).collect();
        let largest = next.iter().fold(0.0_f64, |m, v| m.max(*v));
        x = next.iter().map(|v| (v / largest).max(1e-280)).collect();
    }
    best
}

/// Radius of the Jacobian's entry in `column` of an equation: from the radii of poses and parameters and
/// from rounding. `rest` is a motion of nothing, before and after.
pub(super) fn entry_error(
    row: &Row,
    pose: &[f64],
    pose_error: &[f64],
    params: &[Param],
    column: usize,
    rest: &mut [f64],
) -> f64 {
    if !row.hangs_on(column / 3) {
        return 0.0;
    }
    if row.is_plain_in(column) {
        // One, whatever the place; its rate is a sum of that and zeros.
        return PLAIN * U;
    }
    rest[column] = 1.0;
    let linear = row.linear(Motion { pose, rate: rest, accel: &[], params }, 1);
    rest[column] = 0.0;
    let Some(linear) = linear else { return f64::INFINITY };
    let spread: f64 = linear
        .terms
        .iter()
        .filter(|(_, c)| *c != 0.0)
        .map(|(leaf, c)| match leaf {
            Leaf::Pose(at) => c.abs() * pose_error[*at],
            Leaf::Param(at) => c.abs() * params[*at].error,
            Leaf::Rate(_) | Leaf::Accel(_) | Leaf::Force(_) => 0.0,
        })
        .sum();
    spread + linear.rounding + 4.0 * U * linear.value.abs()
}
