//! Graphical against analytic, and both against what somebody published.
//!
//! **Architecture Invariant:** this room compares; it does not know how either result was found, and has
//! no third opinion.

mod beside;
mod carried;
mod confirm;
mod sweep;

use std::borrow::Cow;

pub use confirm::{Disagreement, NotConfirmed, Unconfirmed, confirm, confirm_by, solve_confirmed};

use crate::analytic::AnalyticError;
use crate::graphical::construction::Reading;
use crate::mechanism::force::Force;
use crate::mechanism::quantity::{Answer, Asked, Indeterminate, Quantity, Stuck};
use crate::scene::{Published, Refusal, Scene};
use crate::solve::{Settings, SolveError, Solved};

pub use carried::CarriedAstray;
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

    /// Within their bounds, or not determined. A number where friction lets no balance exist, or more than one, is none.
    #[must_use]
    pub fn agrees(&self) -> bool {
        match (self.difference, &self.analytic) {
            (Some(difference), _) => difference.ratio <= 1.0,
            (None, Answer::Indeterminate(Indeterminate::Rubbing { how, .. })) if *how != Stuck::AtRest => {
                matches!(self.graphical.answer, Answer::Indeterminate(_))
            }
            (None, _) => self.indeterminate().is_some(),
        }
    }

    /// The two answers side by side.
    #[must_use]
    pub fn disagreement(&self) -> Disagreement {
        Disagreement {
            name: self.asked.name.clone(),
            unit: self.asked.unit.clone(),
            graphical: self.graphical.answer.clone(),
            analytic: self.analytic.clone(),
            apart: apart_as_asked(&self.asked.quantity, &self.graphical.answer, &self.analytic),
        }
    }
}

/// Whether the two solvers tell the same story.
#[derive(Debug, Clone, PartialEq)]
pub struct Agreement {
    /// Every asked quantity, in order.
    pub compared: Vec<Compared>,
    /// A point that the two solvers see in different places: another assembly.
    pub elsewhere: Option<Disagreement>,
    /// Forces that act along different lines by the two solvers, each as its moment about a place.
    pub lines: Vec<Disagreement>,
    /// The analytic solver's refusal, if it refused.
    pub refused: Option<String>,
    /// The balance of powers, where a force was asked and it is determined here.
    pub power: Option<crate::analytic::Power>,
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
            && self.elsewhere.is_none()
            && self.lines.is_empty()
            && self.compared.iter().all(Compared::agrees)
            && self.power.is_none_or(|power| power.balances())
    }

    /// The quantities on which they do not agree, in the order in which they were asked; then the lines of forces.
    #[must_use]
    pub fn disagreements(&self) -> Vec<Disagreement> {
        let apart = self.compared.iter().filter(|c| !c.agrees()).map(Compared::disagreement);
        apart.chain(self.lines.iter().cloned()).collect()
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
fn apart_as_asked(quantity: &Quantity, a: &Answer, b: &Answer) -> Option<(f64, f64)> {
    let (distance, bounds) = apart(a, b)?;
    if matches!(quantity, Quantity::Angle(_)) {
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
    match analytic {
        Ok(state) => agreement_by(scene, solved, state),
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
            let lines = Vec::new();
            Agreement { compared, elsewhere: None, lines, refused: Some(error.to_string()), power: None }
        }
    }
}

/// Compares a drawn solution with the state that the independent solver found.
fn agreement_by(scene: &Scene, solved: &Solved, state: &crate::analytic::State) -> Agreement {
    let construction = &solved.solution.construction;
    let asked = scene.mechanism.asked.iter().zip(&construction.answers);
    let compared: Vec<Compared> = asked
        .map(|(asked, reading)| {
            let analytic = state.answer(&asked.quantity);
            let difference =
                apart_as_asked(&asked.quantity, &reading.answer, &analytic).map(|(value, bounds)| {
                    let ratio = if value == 0.0 { 0.0 } else { value / bounds };
                    Difference { value, ratio }
                });
            Compared { asked: asked.clone(), graphical: reading.clone(), analytic, difference }
        })
        .collect();
    // Of what does not come together for the one solver the other may have no number either.
    let alone = |compared: &Compared| {
        matches!(compared.analytic, Answer::Indeterminate(_))
            && !matches!(compared.graphical.answer, Answer::Indeterminate(_))
    };
    let refused = state.refused().filter(|_| compared.iter().any(alone)).map(ToString::to_string);
    Agreement {
        compared,
        elsewhere: elsewhere(scene, solved, state),
        lines: other_lines(scene, solved, state),
        refused,
        power: state.power(),
    }
}

/// The forces that act along another line by the one solver than by the other. The bound of a drawn moment costs a sweep
/// through the tape, and is not needed where the analytic bound suffices.
fn other_lines(scene: &Scene, solved: &Solved, state: &crate::analytic::State) -> Vec<Disagreement> {
    let mut tape = None;
    let mut apart_from = |line: &crate::graphical::Shown| {
        let Quantity::Force(Force::Moment(action, _), share) = line.quantity else { return None };
        // What is no force has no line.
        if !matches!(state.answer(&Quantity::Force(Force::Vector(action), share)), Answer::Vector { .. }) {
            return None;
        }
        let analytic = state.answer(&line.quantity);
        let (distance, bounds) = apart(&line.as_read(), &analytic)?;
        if distance <= bounds {
            return None;
        }
        let graphical = line.answer(tape.get_or_insert_with(|| solved.solution.tape.clone()));
        let (distance, bounds) = apart(&graphical, &analytic)?;
        (distance > bounds).then(|| Disagreement {
            name: line.quantity.name(&scene.mechanism),
            unit: crate::scene::unit_of(&line.quantity, scene),
            graphical,
            analytic,
            apart: Some((distance, bounds)),
        })
    };
    solved.solution.lines.iter().filter_map(&mut apart_from).collect()
}

/// The first point that stands in another place by the one solver than by the other. What the independent solver was
/// not asked for has no place there.
fn elsewhere(scene: &Scene, solved: &Solved, state: &crate::analytic::State) -> Option<Disagreement> {
    let solution = &solved.solution;
    let space = &solution.construction.space;
    let places = space.places.iter().flatten();
    let size = places.map(|p| libm::hypot(p[0], p[1]) * space.metres_per_mm).fold(0.0, f64::max);
    let mut tape = None;
    solution.shown.iter().find_map(|shown| {
        let Quantity::Position(point) = shown.quantity else { return None };
        // A bound follows a place through every equation: it is not needed where the places are one to the eye.
        let seen = Answer::Vector { value: state.seen_at(point)?, bound: 0.0 };
        let (distance, _) = apart(&shown.as_read(), &seen)?;
        if distance <= OTHER_BRANCH * size {
            return None;
        }
        let found = state.pose(point).ok()?;
        let analytic = Answer::Vector { value: found.at, bound: found.bound };
        // Far behind a dead centre, or on a guide that is given from afar, a place may be known no better.
        let graphical = shown.answer(tape.get_or_insert_with(|| solution.tape.clone()));
        let (distance, bounds) = apart(&graphical, &analytic)?;
        (distance > OTHER_BRANCH * size + bounds).then(|| Disagreement {
            name: shown.quantity.name(&scene.mechanism),
            unit: scene.units.length.clone(),
            graphical,
            analytic,
            apart: Some((distance, bounds)),
        })
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
            let as_expected = scene.expect.is_none_or(|expected| refuses_balance(&agreement, expected));
            let ok = as_expected && agreement.ok() && published.iter().all(|p| p.ok != p.erratum);
            SceneCheck { outcome: Outcome::Solved { agreement, published }, ok }
        }
    }
}

/// Whether what hangs on the balance of forces is refused as expected, whatever else was asked beside it: weights and
/// inertia are there in any case.
fn refuses_balance(agreement: &Agreement, expected: Refusal) -> bool {
    let refused = agreement.compared.iter().filter_map(|compared| {
        let why = compared.indeterminate()?.clone();
        SolveError::Indeterminate { name: compared.asked.name.clone(), why }.refusal()
    });
    let refused: Vec<Refusal> = refused.collect();
    matches!(expected, Refusal::Locked | Refusal::NoEquilibrium)
        && !refused.is_empty()
        && refused.iter().all(|refusal| *refusal == expected)
}

/// One solution that answers the asked quantities and then the published ones; the agreement covers both.
fn solve_for_check(scene: &Scene, settings: Settings) -> Result<(Agreement, Vec<Answer>), SolveError> {
    let mut both = Cow::Borrowed(scene);
    if !scene.published.is_empty() {
        both.to_mut().mechanism.asked.extend(scene.published.iter().map(|p| p.asked.clone()));
    }
    let solved = crate::solve::solve_numbers(&both, settings)?;
    let asked = scene.mechanism.asked.len();
    // What was published must not hide that nothing asked is determined.
    crate::solve::determined(&scene.mechanism.asked, &solved.solution.construction.answers[..asked])?;
    let agreement = agreement(&both, &solved, &crate::solve::solve_analytically(&both));
    let answers = solved.solution.construction.answers[asked..].iter().map(|r| r.answer.clone()).collect();
    Ok((agreement, answers))
}
