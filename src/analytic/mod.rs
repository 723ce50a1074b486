//! The independent solver: constraint equations of all pairs in body coordinates, solved by Newton's
//! iteration and by linear systems with one Jacobian.
//!
//! Each moving link has a pose (x, y, θ) of its own coordinates; each pair and each input gives equations
//! between them. [`solve`] finds the assembly nearest to the hints, then velocities and accelerations;
//! [`State::answer`] reads any quantity off, with a bound that covers the errors of the given numbers,
//! rounding, residuals, and their way through every equation.
//!
//! - A link of two or more points of given place, or of [`crate::mechanism::Form::Placed`], is where these
//!   points put it; pairs between such links need only hold to 2e-6 of the mechanism's size.
//! - A wheel (one joint, not ridden, not driven to an angle) has θ = 0 at this instant; rolling has no
//!   position equation but the contact, and that only where nothing else holds the distance.
//! - A place that the scene states by two loci is solved for before anything else (`figure.rs`): each locus is
//!   an equation of a circle or a line, and the point counts as placed with the bound that comes out.
//! - A block on an arc has its x-axis along the tangent, ccw about the centre of curvature.
//!
//! Numbers near a dead centre are refused, not guessed: where the first-order error of the Jacobian passes
//! an eighth of its distance from singularity (spectral radius of |J⁻¹| |δJ|), the group of links and all
//! that follows from it is [`crate::mechanism::quantity::Indeterminate::Singular`]; what does not depend
//! on it keeps its value. Positions there keep a bound of the order of the root of the rounding.
//!
//! **Architecture Invariant:** nothing here knows the board or the graphical method; the two solvers share
//! the [`Mechanism`] and nothing else.

mod assembly;
mod constraints;
mod cycle;
mod cycle_work;
mod figure;
mod forces;
mod friction;
mod linear;
mod model;
mod motion;
mod ordering;
mod quantities;
mod sketch;
mod slopes;
mod state;
mod statics;
mod tape;
#[cfg(test)]
mod tests;

use thiserror::Error;

use crate::mechanism::Mechanism;
use crate::mechanism::quantity::{Order, Quantity};

pub use cycle::Standing;
pub use forces::Power;
pub use state::{Spot, State};

/// Why a mechanism has no solution.
#[derive(Debug, Clone, PartialEq, Error)]
#[non_exhaustive]
pub enum AnalyticError {
    /// The links cannot be brought together.
    #[error("links {} cannot be assembled: {residual:e} m are missing", list(links))]
    CannotAssemble {
        /// Numbers of the links in the first group that does not close, ascending; the links before it
        /// close.
        links: Vec<u32>,
        /// Least miss of an equation, metres (for an equation of angles, radians times the mechanism's
        /// size).
        residual: f64,
    },
    /// Two assemblies, and no hint that tells them apart.
    #[error("two assemblies fit: no rough place (`near`) tells where {} lies", points.join(" or "))]
    Ambiguous {
        /// Names of the points that lie elsewhere in the second assembly, or of the links that stand otherwise.
        points: Vec<String>,
    },
    /// The inputs and places do not determine the position.
    #[error("the position of links {} is not determined", list(links))]
    Underdetermined {
        /// Numbers of the links that are left free, ascending.
        links: Vec<u32>,
    },
    /// A redundant pair or input contradicts the motion of the others.
    #[error("the inputs contradict each other or the pairs")]
    Contradictory,
    /// A point does not stand where the scene states it.
    #[error("{point} cannot be placed: {why}")]
    Unplaced {
        /// Its name.
        point: String,
        /// Why not, one clause.
        why: String,
    },
    /// The motion takes two bodies apart that roll on each other.
    #[error("{why}")]
    ComesApart {
        /// Which, and how fast.
        why: String,
    },
    /// A load against the motion of a point at rest, or a spring without length: it points nowhere.
    #[error("a force points along a line without length")]
    Directionless,
    /// The mechanism is not one: an index out of range, a dimension of zero, a point without coordinates.
    #[error("not a mechanism: {what}")]
    Malformed {
        /// What is wrong.
        what: String,
    },
}

fn list(links: &[u32]) -> String {
    links.iter().map(u32::to_string).collect::<Vec<_>>().join(", ")
}

/// Solves the mechanism at this instant up to the given order.
///
/// # Errors
/// Where no position or more than one is found, or the mechanism contradicts itself: [`AnalyticError`]. A
/// singular position is not an error: the quantities that depend on it are indeterminate.
pub fn solve(mechanism: &Mechanism, order: Order) -> Result<State, AnalyticError> {
    State::new(mechanism, order, 0.0, None)
}

/// Solves only what these quantities depend on. A group of links that none of them needs may be impossible, possible in
/// two ways or at a dead centre: it changes nothing. Other quantities are undefined in the answer.
///
/// # Errors
/// See [`solve`], of the groups that are needed.
pub fn solve_for(mechanism: &Mechanism, quantities: &[Quantity]) -> Result<State, AnalyticError> {
    let order = quantities.iter().map(Quantity::order).max().unwrap_or(Order::Position);
    let order = if quantities.iter().any(|q| matches!(q, Quantity::Force(..))) {
        // The balance of powers needs velocities, whatever the forces hang on.
        order.max(mechanism.forces.order()).max(Order::Velocity)
    } else {
        order
    };
    State::new(mechanism, order, 0.0, Some(quantities))
}

/// Tries to tell the quantities that stand from those that do not are no more.
const MOST_TRIES: usize = 64;

/// As [`solve_for`]; where links do not come together on which some of the quantities hang, the others are solved, and
/// [`State::refused`] says what was not. A later dyad just at the end of its reach misses it by a rounding.
///
/// # Errors
/// See [`solve_for`]; that links cannot be assembled only where every quantity hangs on them.
pub fn solve_what_closes(mechanism: &Mechanism, quantities: &[Quantity]) -> Result<State, AnalyticError> {
    match solve_for(mechanism, quantities) {
        Err(error @ AnalyticError::CannotAssemble { .. }) => {
            let mut closing = Vec::new();
            let mut tries = MOST_TRIES;
            closing_among(mechanism, quantities, &mut closing, &mut tries);
            if closing.is_empty() {
                return Err(error);
            }
            let mut state = solve_for(mechanism, &closing)?;
            state.refused = Some(error);
            Ok(state)
        }
        found => found,
    }
}

/// Those of some quantities, which do not stand together, that stand; by halves, as long as there are tries left.
fn closing_among(mechanism: &Mechanism, of: &[Quantity], closing: &mut Vec<Quantity>, tries: &mut usize) {
    let (first, second) = of.split_at(of.len() / 2);
    for half in [first, second] {
        if half.is_empty() || half.len() == of.len() || *tries == 0 {
            continue;
        }
        *tries -= 1;
        if solve_for(mechanism, half).is_ok() {
            closing.extend_from_slice(half);
        } else {
            closing_among(mechanism, half, closing, tries);
        }
    }
}

/// As [`solve_for`], with the turning-moment diagram: `standing` gives the mechanism at other angles of its input.
///
/// # Errors
/// See [`solve`].
pub fn solve_cycle(
    mechanism: &Mechanism,
    quantities: &[Quantity],
    standing: Option<Standing<'_>>,
) -> Result<State, AnalyticError> {
    let mut state = solve_for(mechanism, quantities)?;
    if let Some(cycle) = &mechanism.forces.cycle {
        let of_steepest =
            |quantity: &Quantity| matches!(quantity, Quantity::Cycle(of) if of.is_of_steepest());
        let steepest = quantities.iter().any(of_steepest);
        state.cycle = Some(cycle::turning(cycle, mechanism.forces.gravity.g, standing, steepest));
    }
    Ok(state)
}

/// As [`solve`], but Newton's iteration ends where no equation of the position misses by more than
/// `tolerance` mechanism sizes (or radians): quicker and less exact, with bounds that say so.
///
/// # Errors
/// See [`solve`].
pub fn solve_within(mechanism: &Mechanism, order: Order, tolerance: f64) -> Result<State, AnalyticError> {
    State::new(mechanism, order, tolerance, None)
}
