//! From a scene to its checked solution: the whole way in one call.

use crate::analytic::{self, AnalyticError, State};
pub use crate::board::{Arithmetic, Hand};
use crate::graphical::construction::Reading;
use crate::graphical::{self, Draughtsmen, DrawError, Extents, HandError, Scales, Solution};
use crate::mechanism::quantity::{Answer, Asked, Indeterminate, Order};
use crate::mechanism::structure::{Structure, StructureError};
use crate::plan::{Auxiliary, CentreSource, Extent, Plan};
use crate::scene::{Refusal, Scene};
use crate::sweep::{self, PositionError};

/// How to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Settings {
    /// The arithmetic of the board.
    pub arithmetic: Arithmetic,
}

/// A scene taken apart, planned and drawn.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The mechanism's mobility and groups.
    pub structure: Structure,
    /// The steps that were needed.
    pub plan: Plan,
    /// The scales at which it was drawn.
    pub scales: Scales,
    /// The graphical solution.
    pub solution: Solution,
}

/// Why a scene has no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The freedoms do not match the inputs.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The skeleton cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Another position that the sheet is to show cannot be drawn.
    #[error(transparent)]
    Position(#[from] PositionError),
    /// Nothing that was asked has a meaning here, or a construction.
    #[error("{name}: {why}")]
    Unanswered {
        /// The first asked quantity.
        name: String,
        /// Why there is no answer.
        why: Indeterminate,
    },
    /// Nothing that was asked is determined at this position.
    #[error("indeterminate here: {why}")]
    Indeterminate {
        /// The first asked quantity.
        name: String,
        /// Why it is not determined.
        why: Indeterminate,
    },
}

impl SolveError {
    /// The refusal that a scene may expect, where this is one.
    #[must_use]
    pub fn refusal(&self) -> Option<Refusal> {
        match self {
            Self::Draw(DrawError::CannotAssemble { .. } | DrawError::NoClosure { .. }) => {
                Some(Refusal::CannotAssemble)
            }
            Self::Draw(DrawError::Ambiguous { .. } | DrawError::NotPlaced { .. }) => Some(Refusal::Ambiguous),
            Self::Indeterminate { .. } => Some(Refusal::Indeterminate),
            Self::Unanswered { .. }
            | Self::Structure(_)
            | Self::Position(_)
            | Self::Draw(DrawError::NoConstruction { .. } | DrawError::Missing(_)) => None,
        }
    }
}

/// Draws the solution of a scene, at the scales that it states or that `choose` finds for the size of its
/// diagrams, in double precision.
///
/// # Errors
/// See [`SolveError`].
pub fn solve(
    scene: &Scene,
    extent: Extent,
    choose: impl Fn(&Scene, Extents) -> Scales,
) -> Result<Solved, SolveError> {
    solve_with(scene, extent, &[], Settings::default(), choose)
}

/// As [`solve`], with constructions on the skeleton besides those by which a quantity is asked, and with
/// settings of choice.
///
/// # Errors
/// See [`SolveError`].
pub fn solve_with(
    scene: &Scene,
    extent: Extent,
    auxiliary: &[Auxiliary],
    settings: Settings,
    choose: impl Fn(&Scene, Extents) -> Scales,
) -> Result<Solved, SolveError> {
    let structure = Structure::of(&scene.mechanism)?;
    // Other positions are for figures.
    let (inputs, assembly): (&[f64], bool) = match extent {
        Extent::Asked => (&[], false),
        _ => (&scene.sheet.positions, scene.sheet.other_assembly),
    };
    let others = sweep::other_positions(&scene.mechanism, inputs, assembly)?;
    let draw = |plan: &Plan| {
        let extents = graphical::extents(&scene.mechanism, &structure, plan)?.with(&others);
        let scales = choose(scene, extents);
        let drawn = graphical::construct_in(settings.arithmetic, &scene.mechanism, &structure, plan, scales);
        drawn.map(|solution| (scales, solution))
    };
    let plan_from = |source| Plan::with_auxiliary(&scene.mechanism, &structure, extent, source, auxiliary);
    let mut plan = plan_from(CentreSource::Diagram);
    let (mut scales, mut solution) = draw(&plan)?;
    if solution.construction.circle.as_ref().is_some_and(|circle| !circle.stalled.is_empty()) {
        plan = plan_from(CentreSource::Velocities);
        (scales, solution) = draw(&plan)?;
    }
    determined(&scene.mechanism.asked, &solution.construction.answers)?;
    solution.construction.others = others;
    Ok(Solved { structure, plan, scales, solution })
}

/// The errors that careful draughtsmen make in each asked quantity, at the scales of the solution.
///
/// # Errors
/// [`SolveError::Draw`], where not even a perfect hand can draw it.
pub fn by_hand(
    scene: &Scene,
    solved: &Solved,
    draughtsmen: Draughtsmen,
) -> Result<Vec<HandError>, SolveError> {
    let errors =
        graphical::by_hand(&scene.mechanism, &solved.structure, &solved.plan, solved.scales, draughtsmen)?;
    Ok(errors)
}

impl Solved {
    /// The answer to the question of this name, as the scene words it: `v(B)`. `None` where the scene does not ask it.
    #[must_use]
    pub fn answer(&self, scene: &Scene, name: &str) -> Option<&Answer> {
        let index = scene.mechanism.asked.iter().position(|asked| asked.name == name)?;
        self.solution.construction.answers.get(index).map(|reading| &reading.answer)
    }
}

/// Refuses where none of the asked quantities is determined.
///
/// # Errors
/// [`SolveError::Indeterminate`], or [`SolveError::Unanswered`] where it is not the position's fault.
pub fn determined(asked: &[Asked], readings: &[Reading]) -> Result<(), SolveError> {
    let mut reasons = Vec::new();
    for (asked, reading) in asked.iter().zip(readings) {
        match &reading.answer {
            Answer::Indeterminate(why) => reasons.push((asked.name.clone(), why.clone())),
            _ => return Ok(()),
        }
    }
    let position = reasons.iter().position(|(_, why)| !matches!(why, Indeterminate::Undefined { .. }));
    match (position, reasons.into_iter().nth(position.unwrap_or(0))) {
        (_, None) => Ok(()),
        (Some(_), Some((name, why))) => Err(SolveError::Indeterminate { name, why }),
        (None, Some((name, why))) => Err(SolveError::Unanswered { name, why }),
    }
}

/// Solves the same scene with the independent solver, as far as the asked quantities need.
///
/// # Errors
/// See [`AnalyticError`].
pub fn solve_analytically(scene: &Scene) -> Result<State, AnalyticError> {
    let order = scene.mechanism.asked.iter().map(|a| a.quantity.order()).max().unwrap_or(Order::Position);
    analytic::solve(&scene.mechanism, order)
}
