//! Graphical against analytic, and both against what somebody published.
//!
//! **Architecture Invariant:** this room compares; it does not know how either result was found, and has
//! no third opinion.

mod sweep;

use std::borrow::Cow;

use crate::analytic::AnalyticError;
use crate::graphical::construction::Reading;
use crate::mechanism::PointId;
use crate::mechanism::quantity::{Answer, Asked, Indeterminate, Quantity};
use crate::scene::{Published, Refusal, Scene};
use crate::solve::{Settings, SolveError, Solved};

pub use sweep::{MOST_POSITIONS, SweepUnconfirmed, SweptApart, confirm_sweep};

/// One asked quantity by both solvers.
#[derive(Debug, Clone, PartialEq)]
pub struct Compared {
    /// What was asked.
    pub asked: Asked,
    /// The graphical answer.
    pub graphical: Reading,
    /// The analytic answer.
    pub analytic: Answer,
    /// |graphical − analytic| and its ratio to the sum of the bounds; `None` where either has no number.
    pub difference: Option<Difference>,
}

/// How far two numbers are apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Difference {
    /// |graphical − analytic| in SI units.
    pub value: f64,
    /// That over the sum of the two bounds: at most 1 where they agree.
    pub ratio: f64,
}

impl Compared {
    /// The reason why there is no number, from whichever solver gave one.
    #[must_use]
    pub fn indeterminate(&self) -> Option<&Indeterminate> {
        match (&self.graphical.answer, &self.analytic) {
            (Answer::Indeterminate(why), _) | (_, Answer::Indeterminate(why)) => Some(why),
            _ => None,
        }
    }
}

/// Whether the two solvers tell the same story.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Every asked quantity, in order.
    pub compared: Vec<Compared>,
    /// Name of a point that the two solvers see in different places: another assembly.
    pub wrong_branch: Option<String>,
    /// The analytic solver's refusal, if it refused.
    pub refused: Option<String>,
}

impl Agreement {
    /// The largest difference over the sum of bounds.
    #[must_use]
    pub fn worst_ratio(&self) -> f64 {
        self.compared.iter().filter_map(|c| c.difference).map(|d| d.ratio).fold(0.0, f64::max)
    }

    /// Everything agrees.
    #[must_use]
    pub fn ok(&self) -> bool {
        self.refused.is_none()
            && self.wrong_branch.is_none()
            && self.compared.iter().filter_map(|c| c.difference).all(|d| d.ratio <= 1.0)
            && self.compared.iter().all(|c| c.difference.is_some() || c.indeterminate().is_some())
    }
}

/// Distance of two answers and the sum of their bounds.
fn apart(a: &Answer, b: &Answer) -> Option<(f64, f64)> {
    match (a, b) {
        (Answer::Scalar { value, bound }, Answer::Scalar { value: other, bound: other_bound }) => {
            Some(((value - other).abs(), bound + other_bound))
        }
        (Answer::Vector { value, bound }, Answer::Vector { value: other, bound: other_bound }) => {
            Some((libm::hypot(value[0] - other[0], value[1] - other[1]), bound + other_bound))
        }
        (
            Answer::AtInfinity { direction, bound },
            Answer::AtInfinity { direction: other, bound: other_bound },
        ) => {
            let cross = direction[0] * other[1] - direction[1] * other[0];
            Some((libm::asin(cross.abs().min(1.0)), bound + other_bound))
        }
        _ => None,
    }
}

/// An angle read the other way round is the same angle.
fn apart_as_asked(asked: &Asked, a: &Answer, b: &Answer) -> Option<(f64, f64)> {
    let (distance, bounds) = apart(a, b)?;
    if matches!(asked.quantity, Quantity::Angle(_)) {
        let turn = 2.0 * std::f64::consts::PI;
        return Some((distance.min((turn - distance).abs()), bounds));
    }
    Some((distance, bounds))
}

/// Two poses further apart than this part of the mechanism's size, and than their bounds, are two
/// assemblies, not two roundings.
const OTHER_BRANCH: f64 = 1e-6;

/// Compares a drawn solution with the analytic state.
#[must_use]
pub fn agreement(
    scene: &Scene,
    solved: &Solved,
    analytic: &Result<crate::analytic::State, AnalyticError>,
) -> Agreement {
    let construction = &solved.solution.construction;
    let asked = scene.mechanism.asked.iter().zip(&construction.answers);
    let state = match analytic {
        Ok(state) => state,
        Err(error) => {
            let why = Indeterminate::Undefined { why: format!("the analytic solver refused: {error}") };
            let compared = asked
                .map(|(asked, reading)| Compared {
                    asked: asked.clone(),
                    graphical: reading.clone(),
                    analytic: Answer::Indeterminate(why.clone()),
                    difference: None,
                })
                .collect();
            return Agreement { compared, wrong_branch: None, refused: Some(error.to_string()) };
        }
    };
    let compared: Vec<Compared> = asked
        .map(|(asked, reading)| {
            let analytic = state.answer(&asked.quantity);
            let difference = apart_as_asked(asked, &reading.answer, &analytic).map(|(value, bounds)| {
                let ratio = if value == 0.0 { 0.0 } else { value / bounds };
                Difference { value, ratio }
            });
            Compared { asked: asked.clone(), graphical: reading.clone(), analytic, difference }
        })
        .collect();
    Agreement { compared, wrong_branch: wrong_branch(scene, solved, state), refused: None }
}

fn wrong_branch(scene: &Scene, solved: &Solved, state: &crate::analytic::State) -> Option<String> {
    let space = &solved.solution.construction.space;
    let places: Vec<(usize, [f64; 2])> =
        space.places.iter().enumerate().filter_map(|(i, p)| p.map(|p| (i, p))).collect();
    let size = places.iter().map(|(_, p)| libm::hypot(p[0], p[1]) * space.metres_per_mm).fold(0.0, f64::max);
    // The skeleton has its own frame: both are laid on each other at the first point.
    let &(first, at_first) = places.first()?;
    let from = state.pose(PointId(first)).ok()?;
    places.iter().find_map(|&(index, at)| {
        let world = state.pose(PointId(index)).ok()?;
        let drawn = [0, 1].map(|k| (at[k] - at_first[k]) * space.metres_per_mm);
        let found = [0, 1].map(|k| world.at[k] - from.at[k]);
        let apart = libm::hypot(drawn[0] - found[0], drawn[1] - found[1]);
        if apart <= OTHER_BRANCH * size {
            return None;
        }
        // Far behind a dead centre, or on a guide that is given from afar, a place may be known no better.
        let mut tape = solved.solution.tape.clone();
        let stroke = tape.strokes().iter().find(|s| s.at == at).map(|s| s.slots);
        let [x, y] = stroke.map_or([0.0; 2], |slots| slots.map(|slot| tape.bound(slot)));
        let uncertain = world.bound + from.bound + libm::hypot(x, y) * space.metres_per_mm;
        (apart > OTHER_BRANCH * size + uncertain).then(|| scene.mechanism.points[index].name.clone())
    })
}

/// A published value against the computed one.
#[derive(Debug, Clone, PartialEq)]
pub struct PublishedCheck {
    /// The quantity and the unit in which it was printed.
    pub asked: Asked,
    /// Printed, SI; signed where the print states a sense.
    pub published: f64,
    /// Computed, SI; the magnitude of a vector, and of a scalar printed without a sense.
    pub computed: Option<f64>,
    /// 100 (published − computed) / computed; `None` where the computed value is zero or missing.
    pub percent: Option<f64>,
    /// Within what the scene or the command allows.
    pub ok: bool,
    /// The scene says that this print is wrong.
    pub erratum: bool,
}

/// Compares one published value. `tolerance` holds where the scene states none.
#[must_use]
pub fn compare_published(
    published: &Published,
    answer: &Answer,
    tolerance: f64,
    erratum: bool,
) -> PublishedCheck {
    let (computed, bound) = match answer {
        Answer::Scalar { value, bound } if published.signed => (Some(*value), *bound),
        Answer::Scalar { value, bound } => (Some(value.abs()), *bound),
        Answer::Vector { value, bound } => (Some(libm::hypot(value[0], value[1])), *bound),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => (None, 0.0),
    };
    let printed = if published.signed { published.value } else { published.value.abs() };
    let within = published.within.unwrap_or(tolerance);
    // A turn more or less is the same angle.
    let turn = 2.0 * std::f64::consts::PI;
    let printed = match (computed, published.asked.quantity) {
        (Some(c), Quantity::Angle(_)) if published.signed => printed - turn * ((printed - c) / turn).round(),
        _ => printed,
    };
    let ok = computed.is_some_and(|c| (printed - c).abs() <= within * printed.abs().max(c.abs()) + bound);
    let percent = match computed {
        Some(c) if c.abs() > bound => Some(100.0 * (printed - c) / c),
        Some(_) if printed == 0.0 => Some(0.0),
        _ => None,
    };
    PublishedCheck { asked: published.asked.clone(), published: printed, computed, percent, ok, erratum }
}

/// The outcome of one scene.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// It was solved.
    Solved {
        /// Graphical against analytic.
        agreement: Agreement,
        /// Each published value.
        published: Vec<PublishedCheck>,
    },
    /// It was refused.
    Refused {
        /// Which refusal, if one of the three that a scene may expect.
        refusal: Option<Refusal>,
        /// What was said.
        error: SolveError,
    },
}

/// A scene's check.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneCheck {
    /// What happened.
    pub outcome: Outcome,
    /// The scene holds: exactly its errata miss, or exactly its expected refusal occurs.
    pub ok: bool,
}

/// Checks one scene: solves it both ways, once for what it asks and once for what was published.
#[must_use]
pub fn check(scene: &Scene, tolerance: f64) -> SceneCheck {
    check_with(scene, tolerance, Settings::default())
}

/// As [`check()`], with settings of choice.
#[must_use]
pub fn check_with(scene: &Scene, tolerance: f64, settings: Settings) -> SceneCheck {
    match solve_for_check(scene, settings) {
        Err(error) => {
            let refusal = error.refusal();
            let ok = refusal.is_some() && refusal == scene.expect;
            SceneCheck { outcome: Outcome::Refused { refusal, error }, ok }
        }
        Ok((agreement, answers)) => {
            let published: Vec<PublishedCheck> = scene
                .published
                .iter()
                .zip(&answers)
                .map(|(published, answer)| {
                    let erratum = scene.errata.contains(&published.asked.name);
                    compare_published(published, answer, tolerance, erratum)
                })
                .collect();
            let ok = scene.expect.is_none() && agreement.ok() && published.iter().all(|p| p.ok != p.erratum);
            SceneCheck { outcome: Outcome::Solved { agreement, published }, ok }
        }
    }
}

/// One solution that answers the asked quantities and then the published ones; the agreement covers both.
fn solve_for_check(scene: &Scene, settings: Settings) -> Result<(Agreement, Vec<Answer>), SolveError> {
    let mut both = Cow::Borrowed(scene);
    if !scene.published.is_empty() {
        both.to_mut().mechanism.asked.extend(scene.published.iter().map(|p| p.asked.clone()));
    }
    let solved = crate::solve::solve_with(
        &both,
        crate::plan::Extent::Asked,
        &[],
        settings,
        crate::sheet::scale::for_scene,
    )?;
    let asked = scene.mechanism.asked.len();
    // What was published must not hide that nothing asked is determined.
    crate::solve::determined(&scene.mechanism.asked, &solved.solution.construction.answers[..asked])?;
    let agreement = agreement(&both, &solved, &crate::solve::solve_analytically(&both));
    let answers = solved.solution.construction.answers[asked..].iter().map(|r| r.answer.clone()).collect();
    Ok((agreement, answers))
}
