//! Whether the independent solver confirms everything that a sheet shows.
//!
//! A sheet shows more than was asked: every place of its skeleton, every image and every vector of its polygons, every
//! ω and ε of its steps, every instant centre; and beside these (`beside.rs`) the constructions on the skeleton, the
//! velocities carried over by centres, the other positions. All of them are compared, each with its bounds.

use std::collections::HashMap;

use crate::analytic::{self, State};
use crate::board::Tape;
use crate::graphical::construction::{Act, Calculation, Claim, Label, Reference, Vector};
use crate::graphical::{Scales, is_trial};
use crate::mechanism::quantity::{Answer, DiagramKind, Quantity, Unit};
use crate::mechanism::{LinkId, PointId};
use crate::plan::{Auxiliary, Extent};
use crate::report::{describe_in, significant};
use crate::scene::{Scene, unit_of};
use crate::solve::{Settings, SolveError, Solved, solve_with};

use super::{Agreement, agreement_by, apart_as_asked, beside};

/// A quantity on which the solvers do not agree.
#[derive(Debug, Clone, PartialEq)]
pub struct Disagreement {
    /// As a scene names it.
    pub name: String,
    /// The unit in which it is told.
    pub unit: Unit,
    /// The graphical answer.
    pub graphical: Answer,
    /// The analytic answer.
    pub analytic: Answer,
    /// Distance of the two and the sum of their bounds, SI; `None` where they are not of one kind.
    pub apart: Option<(f64, f64)>,
}

impl std::fmt::Display for Disagreement {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let told = |answer| describe_in(&self.unit, answer);
        write!(f, "{} is {} on the drawing", self.name, told(&self.graphical))?;
        write!(f, " and {} by the independent solver", told(&self.analytic))?;
        let Some((distance, bounds)) = self.apart else { return Ok(()) };
        // Directions are compared in radians.
        let (si, symbol) = match self.graphical {
            Answer::AtInfinity { .. } => (1.0, "rad"),
            _ => (self.unit.si, self.unit.symbol.as_str()),
        };
        let (distance, bounds) = (significant(distance / si, 2), significant(bounds / si, 2));
        write!(f, ": {distance} {symbol} apart, where the bounds allow {bounds} {symbol}")
    }
}

/// Why a sheet is not confirmed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unconfirmed {
    /// The two solvers see a point in different places: another assembly.
    #[error("the two solvers stand in different assemblies: {0}; give a nearer `near`")]
    Assembly(Box<Disagreement>),
    /// A number is not confirmed.
    #[error("{first}{}", others(*.more))]
    Number {
        /// The first of them.
        first: Box<Disagreement>,
        /// How many more there are.
        more: usize,
    },
    /// The independent solver has no solution.
    #[error("the independent solver refuses: {0}")]
    Refused(#[from] analytic::AnalyticError),
}

fn others(more: usize) -> String {
    match more {
        0 => String::new(),
        1 => "; and one more quantity".to_owned(),
        more => format!("; and {more} more quantities"),
    }
}

impl Unconfirmed {
    /// The quantity that it is about, as a scene names it.
    #[must_use]
    pub fn name(&self) -> Option<&str> {
        match self {
            Self::Assembly(disagreement) | Self::Number { first: disagreement, .. } => {
                Some(&disagreement.name)
            }
            Self::Refused(_) => None,
        }
    }
}

/// Why there is no confirmed solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotConfirmed {
    /// There is no solution.
    #[error(transparent)]
    Unsolved(#[from] SolveError),
    /// There is one, and the independent solver does not confirm it.
    #[error(transparent)]
    Unconfirmed(#[from] Unconfirmed),
}

/// Solves as [`solve_with`] does, and has everything confirmed that a sheet of it shows.
///
/// # Errors
/// See [`NotConfirmed`].
pub fn solve_confirmed(
    scene: &Scene,
    extent: Extent,
    auxiliary: &[Auxiliary],
    settings: Settings,
    choose: impl Fn(&Scene, crate::graphical::Extents) -> Scales,
) -> Result<Solved, NotConfirmed> {
    let solved = solve_with(scene, extent, auxiliary, settings, choose)?;
    if !settings.unchecked {
        confirm(scene, &solved)?;
    }
    Ok(solved)
}

/// Solves by the independent solver what a drawing shows, and compares.
///
/// # Errors
/// See [`Unconfirmed`].
pub fn confirm(scene: &Scene, solved: &Solved) -> Result<(), Unconfirmed> {
    let asked = scene.mechanism.asked.iter().map(|asked| asked.quantity);
    let shown = solved.solution.shown.iter().map(|shown| shown.quantity);
    let beside = beside::quantities(scene, &solved.solution.construction);
    let quantities: Vec<Quantity> = asked.chain(shown).chain(beside).collect();
    let state = crate::solve::solve_analytically_for(scene, &quantities)?;
    confirm_by(scene, solved, &state)?;
    beside::confirm_positions(scene, &solved.solution.construction)
}

/// Compares what a drawing shows with the state of the independent solver.
///
/// # Errors
/// [`Unconfirmed::Assembly`] or [`Unconfirmed::Number`].
pub fn confirm_by(scene: &Scene, solved: &Solved, state: &State) -> Result<(), Unconfirmed> {
    let told = agreement_by(scene, solved, state);
    if let Some(elsewhere) = told.elsewhere {
        return Err(Unconfirmed::Assembly(Box::new(elsewhere)));
    }
    let mut wrong = unconfirmed_answers(&told);
    let mut seen = Comparison::new(scene, solved, state);
    seen.everything_shown();
    wrong.extend(seen.wrong);
    wrong.extend(beside::wrong(scene, &solved.solution.construction, state));
    let mut wrong = wrong.into_iter();
    match wrong.next() {
        None => Ok(()),
        Some(first) => {
            let more = wrong.filter(|other| other.name != first.name).count();
            Err(Unconfirmed::Number { first: Box::new(first), more })
        }
    }
}

/// The asked quantities for which a sheet would print a number that is not confirmed.
fn unconfirmed_answers(told: &Agreement) -> Vec<Disagreement> {
    let mut wrong = told.disagreements();
    let alone = told.compared.iter().filter(|compared| {
        matches!(compared.analytic, Answer::Indeterminate(_))
            && !matches!(compared.graphical.answer, Answer::Indeterminate(_))
    });
    wrong.extend(alone.map(super::Compared::disagreement));
    wrong
}

/// What a piece of ink stands for.
enum Meaning {
    /// A quantity.
    Is(Quantity),
    /// The vector from one image to another: the second less the first, each none for the pole.
    Between([Option<Quantity>; 2]),
    /// A part of the motion of the point of a link under a pin about the point of the link under another.
    PartAbout { pin: PointId, link: LinkId, from: PointId, normal: bool },
}

/// On a skeleton it is seen that a place is off by more than this part of the whole.
const SEEN: f64 = 1e-3;

/// What is being compared.
struct Comparison<'a> {
    scene: &'a Scene,
    solved: &'a Solved,
    state: &'a State,
    /// A copy of the tape, made when the first bound is wanted.
    tape: Option<Tape>,
    /// What is shown, by what it is.
    at: HashMap<Quantity, usize>,
    /// The analytic answers.
    answers: HashMap<Quantity, Answer>,
    wrong: Vec<Disagreement>,
}

impl<'a> Comparison<'a> {
    fn new(scene: &'a Scene, solved: &'a Solved, state: &'a State) -> Self {
        let shown = solved.solution.shown.iter().enumerate();
        let at = shown.map(|(index, shown)| (shown.quantity, index)).collect();
        Self { scene, solved, state, tape: None, at, answers: HashMap::new(), wrong: Vec::new() }
    }

    fn everything_shown(&mut self) {
        for shown in &self.solved.solution.shown {
            // About what such a part turns only its ink tells.
            let part =
                matches!(shown.quantity, Quantity::CoincidentNormal(..) | Quantity::CoincidentTangential(..));
            let mates = match shown.quantity {
                Quantity::RelativeNormal(p, o) | Quantity::RelativeTangential(p, o) => self.common_link(p, o),
                _ => true,
            };
            if !part && mates {
                self.compare(shown.quantity, &Meaning::Is(shown.quantity), &shown.as_read());
            }
        }
        for (quantity, meaning, drawn) in self.drawn() {
            self.compare(quantity, &meaning, &drawn);
        }
    }

    fn common_link(&self, p: PointId, o: PointId) -> bool {
        let links = |point: PointId| &self.scene.mechanism.point(point).links;
        links(p).iter().any(|link| links(o).contains(link))
    }

    fn analytic(&mut self, quantity: Quantity) -> Answer {
        let state = self.state;
        self.answers.entry(quantity).or_insert_with(|| state.answer(&quantity)).clone()
    }

    /// What the independent solver says of a piece of ink.
    fn expected(&mut self, meaning: &Meaning) -> Answer {
        match *meaning {
            Meaning::Is(quantity) => self.analytic(quantity),
            Meaning::PartAbout { pin, link, from, normal } => {
                self.state.part_of_turning(pin, link, from, normal)
            }
            Meaning::Between(ends) => {
                let mut sum = ([0.0; 2], 0.0);
                for (end, sign) in ends.into_iter().zip([-1.0, 1.0]) {
                    match end.map(|quantity| self.analytic(quantity)) {
                        None => {}
                        Some(Answer::Vector { value, bound }) => {
                            sum = ([0, 1].map(|axis| sum.0[axis] + sign * value[axis]), sum.1 + bound);
                        }
                        Some(other) => return other,
                    }
                }
                // The difference of two rounded numbers.
                let rounding = f64::EPSILON * libm::hypot(sum.0[0], sum.0[1]);
                Answer::Vector { value: sum.0, bound: sum.1 + rounding }
            }
        }
    }

    /// The bound of what the drawing has for this; none where it is not determined, and no number is printed for it.
    fn bound_on_paper(&mut self, quantity: Quantity, meaning: &Meaning) -> Option<f64> {
        let tape = self.tape.get_or_insert_with(|| self.solved.solution.tape.clone());
        let mut bound_of = |quantity: &Quantity| {
            let shown = &self.solved.solution.shown[*self.at.get(quantity)?];
            match shown.answer(tape) {
                Answer::Scalar { bound, .. }
                | Answer::Vector { bound, .. }
                | Answer::AtInfinity { bound, .. } => Some(bound),
                Answer::Indeterminate(_) => None,
            }
        };
        match meaning {
            Meaning::Between(ends) => ends.iter().flatten().map(bound_of).sum(),
            Meaning::Is(_) | Meaning::PartAbout { .. } => bound_of(&quantity),
        }
    }

    /// Compares a number of the sheet with what it stands for. The bound of what was read costs a sweep through the
    /// tape, and is not needed where the analytic bound suffices.
    fn compare(&mut self, quantity: Quantity, meaning: &Meaning, drawn: &Answer) {
        let analytic = self.expected(meaning);
        let apart = apart_as_asked(&quantity, drawn, &analytic);
        if apart.is_some_and(|(distance, bounds)| distance <= bounds) {
            return;
        }
        let Some(bound) = self.bound_on_paper(quantity, meaning) else { return };
        // Ink is the read number to the rounding of its ends, which stands with it.
        let mut apart = apart.map(|(distance, bounds)| (distance, bounds + 2.0 * bound));
        // A place that nothing tells is within its bounds wherever it is drawn.
        if let (Quantity::Position(_), Some((_, bounds))) = (quantity, &mut apart) {
            *bounds = bounds.min(SEEN * self.solved.solution.construction.space.size());
        }
        if apart.is_some_and(|(distance, bounds)| distance <= bounds) {
            return;
        }
        self.wrong.push(Disagreement {
            name: quantity.name(&self.scene.mechanism),
            unit: unit_of(&quantity, self.scene),
            graphical: drawn.clone(),
            analytic,
            apart,
        });
    }

    /// What the ink says: images and vectors as they lie, and the rates that the steps calculate. Where a vector stands
    /// for the point of a link under a pin of another, its name alone does not tell of which link it is; its ends do.
    fn drawn(&self) -> Vec<(Quantity, Meaning, Answer)> {
        let construction = &self.solved.solution.construction;
        // A short vector far from the pole is no better known than the places of its ends are written.
        let written = |at: [f64; 2]| f64::EPSILON * libm::hypot(at[0], at[1]);
        let vector = |from: [f64; 2], to: [f64; 2], scale: f64| Answer::Vector {
            value: [0, 1].map(|axis| (to[axis] - from[axis]) * scale),
            bound: (written(from) + written(to)) * scale,
        };
        let mut drawn = Vec::new();
        for polygon in &construction.diagrams {
            let scale = polygon.si_per_mm;
            drawn.extend(polygon.images.iter().filter_map(|image| {
                let quantity = self.image(polygon.kind, image.label)?;
                Some((quantity, Meaning::Is(quantity), vector([0.0; 2], image.at, scale)))
            }));
            let vectors = polygon.vectors.iter().filter(|v| !is_trial(v));
            drawn.extend(vectors.map(|v| {
                let to = if v.is_zero { v.from } else { v.to };
                (v.quantity, self.meaning(polygon.kind, v), vector(v.from, to, scale))
            }));
        }
        for act in construction.steps.iter().flat_map(|step| &step.acts) {
            let Act::Calculate(calculation) = act else { continue };
            let rate = |quantity: Quantity, value: f64| {
                (quantity, Meaning::Is(quantity), Answer::Scalar { value, bound: 0.0 })
            };
            drawn.extend(match *calculation {
                Calculation::Omega { link, value, .. } => Some(rate(Quantity::Omega(link), value)),
                Calculation::Alpha { link, value, .. } => Some(rate(Quantity::Alpha(link), value)),
                _ => None,
            });
        }
        drawn
    }

    /// Of which point, or of the point of which link under it, an image is.
    fn image(&self, kind: DiagramKind, label: Label) -> Option<Quantity> {
        let Label::Image { point, link } = label else { return None };
        let under = link.filter(|link| !self.scene.mechanism.link(*link).points.contains(&point));
        Some(match (kind, under) {
            (DiagramKind::Acceleration, None) => Quantity::Acceleration(point),
            (DiagramKind::Acceleration, Some(link)) => Quantity::CoincidentAcceleration(point, link),
            (_, None) => Quantity::Velocity(point),
            (_, Some(link)) => Quantity::CoincidentVelocity(point, link),
        })
    }

    fn meaning(&self, kind: DiagramKind, vector: &Vector) -> Meaning {
        let about = |pin: PointId, link: LinkId, normal: bool| match vector.claim {
            Some(
                Claim::Parallel(Reference::Points(from, _))
                | Claim::Perpendicular(Reference::Points(from, _)),
            ) => Some(Meaning::PartAbout { pin, link, from, normal }),
            _ => None,
        };
        let ends = [vector.tail, vector.head];
        let told = match vector.quantity {
            Quantity::CoincidentNormal(pin, link) => about(pin, link, true),
            Quantity::CoincidentTangential(pin, link) => about(pin, link, false),
            Quantity::RelativeNormal(p, o) | Quantity::RelativeTangential(p, o)
                if !self.common_link(p, o) =>
            {
                let link = ends.iter().find_map(|label| match label {
                    Label::Image { link, .. } | Label::Foot { link, .. } => *link,
                    _ => None,
                });
                link.and_then(|link| about(p, link, matches!(vector.quantity, Quantity::RelativeNormal(..))))
            }
            // From the end of how a pin is driven along its lever: what the lever's turning gives the point under it.
            Quantity::CoincidentVelocity(..) if matches!(vector.tail, Label::Foot { .. }) => {
                match vector.claim {
                    Some(Claim::Perpendicular(Reference::Points(from, _))) => {
                        let fixed = self.scene.mechanism.is_fixed(from);
                        let from = (!fixed).then_some(Quantity::Velocity(from));
                        Some(Meaning::Between([from, Some(vector.quantity)]))
                    }
                    _ => None,
                }
            }
            Quantity::RelativeVelocity(..)
            | Quantity::RelativeAcceleration(..)
            | Quantity::CoincidentVelocity(..)
            | Quantity::CoincidentAcceleration(..)
            | Quantity::ContactNormal(..)
                if ends.iter().all(|label| matches!(label, Label::Image { .. } | Label::Pole)) =>
            {
                Some(Meaning::Between(ends.map(|label| self.image(kind, label))))
            }
            _ => None,
        };
        told.unwrap_or(Meaning::Is(vector.quantity))
    }
}
