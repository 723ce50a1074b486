//! Grading of a solution that somebody drew or calculated by hand: which answers are right within what pencil and
//! ruler can do, which follow rightly from an earlier wrong one, and which typical mistake explains the rest.
//!
//! ```
//! let scene = linkgram::scene::read(r#"{
//!   "units": { "length": "cm" },
//!   "fixed": { "O2": [0, 0] },
//!   "links": { "2": { "joins": ["O2", "A"], "length": 15 }, "3": { "joins": ["A", "B"], "length": 45 } },
//!   "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ],
//!   "near":   { "B": [50, 0] },
//!   "input":  { "link": 2, "angle": 30, "omega": "100 rpm cw" },
//!   "find":   ["v(A)", "v(B)"]
//! }"#, "slider.json")?;
//! let handed_in = r#"{ "values": { "v(A)": "1500 cm/s", "v(B)": "971 cm/s" } }"#;
//! let answers = linkgram::grade::read_answers(handed_in, &scene)?;
//! let report = linkgram::grade::grade(&scene, &answers, &Default::default())?;
//! assert_eq!(report.first_fault().unwrap().mistakes[0].kind.name(), "rpm-as-rad");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! **Architecture Invariant:** nothing here solves. A mistake is a changed mechanism, a departure from the right
//! construction (`graphical::Departure`) or a changed reading, and what follows from it is drawn by `graphical/`.

mod answers;
mod assign;
mod case;
mod change;
mod class;
mod csv;
mod digits;
mod drawing;
mod feet;
mod fitted;
mod force_mistakes;
mod judge;
mod kind;
mod mean_line;
mod misread;
mod mistakes;
mod nearest;
mod own;
mod page;
mod phrase;
mod report;
mod routes;
mod scan;
mod schema;
mod steps;
mod svg;
mod symbols;
mod text;
mod turned;
mod unread;
mod variant;
mod weight;
mod words;

#[cfg(feature = "cli")]
pub(crate) use answers::refuse_broken;
pub use answers::{
    Answers, FigurePoints, Form, Given, Item, StatedScales, Tolerance, read_answers, read_named,
};
pub use class::{ClassFault, HandIn, class_csv, class_faults, faults_csv};
#[cfg(feature = "cli")]
pub(crate) use digits::with_plain_digits;
pub use judge::{Mistake, Verdict};
pub use kind::Kind;
pub use phrase::Phrase;
use phrase::say;
pub use report::{Allowed, Amiss, FirstFault, Graded, NotRead, Report, StepMarks, UnstatedScale};
pub use scan::Scan;
pub use schema::schema;
pub use symbols::Symbols;
pub use unread::Unread;
pub use variant::Key;

use crate::board::Hand;
use crate::check::Unconfirmed;
use crate::graphical::construction::Construction;
use crate::mechanism::quantity::{DiagramKind, Order};
use crate::scene::{Diagnostic, Scene};
use crate::sheet::{Figure, Language, Own, Spot};
use crate::solve::SolveError;
use crate::tolerance::DRAUGHTSMEN;
pub use crate::tolerance::MAX_TOLERANCE;

/// How to grade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradeSettings {
    /// How exact a hand is expected.
    pub hand: Hand,
    /// How many draughtsmen draw it for the tolerances.
    pub draughtsmen: u64,
    /// No tolerance is a larger part of the right value.
    pub max_tolerance: f64,
    /// Whether the `tolerance` of the answers counts, uncapped: only where the examiner wrote them himself, such as what a
    /// textbook prints. Nobody sets the tolerance of what he hands in.
    pub trusts_answers: bool,
    /// Whether marks are given by the parts of an exam's key: sense and direction have theirs.
    pub by_parts: bool,
    /// In which language the report is told.
    pub language: Language,
    /// Whether the overlay is for a printed page: in strips, none wider than the page, all names as large as they are to be read.
    pub printed: bool,
}

impl Default for GradeSettings {
    fn default() -> Self {
        Self {
            hand: Hand { length: 0.2, angle: 0.3_f64.to_radians() },
            draughtsmen: DRAUGHTSMEN,
            max_tolerance: MAX_TOLERANCE,
            trusts_answers: false,
            by_parts: false,
            language: Language::default(),
            printed: false,
        }
    }
}

/// Why answers cannot be graded.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GradeError {
    /// The scene has no solution.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// The independent solver does not confirm the right solution.
    #[error(transparent)]
    Unconfirmed(#[from] Unconfirmed),
    /// Something is wrong with the answers.
    #[error(transparent)]
    Answers(Diagnostic),
}

/// Whether a sign is the prime of a letter of an acceleration polygon, as keyboards have it.
fn is_prime(sign: char) -> bool {
    matches!(sign, '\'' | '′' | '’' | '‘' | '´' | 'ʹ' | '`')
}

/// Grades the answers to a scene.
///
/// # Errors
/// See [`GradeError`].
pub fn grade(scene: &Scene, answers: &Answers, settings: &GradeSettings) -> Result<Report, GradeError> {
    let case = case::Case::new(scene, answers, settings)?;
    let judgement = judge::judge(&case, answers.other_variant.is_some());
    Ok(report::report(&case, answers, &judgement))
}

/// As [`grade`], with the student's polygons, as far as the answers tell of them, over the right ones; each fault is
/// circled where the student has it, and named. No figure where nothing that was answered needs a polygon.
///
/// # Errors
/// See [`GradeError`].
pub fn grade_with_overlay(
    scene: &Scene,
    answers: &Answers,
    settings: &GradeSettings,
) -> Result<(Report, Option<Figure>), GradeError> {
    let case = case::Case::new(scene, answers, settings)?;
    let judgement = judge::judge(&case, answers.other_variant.is_some());
    let report = report::report(&case, answers, &judgement);
    let student = case.drawn(&judgement.drawn, None);
    let student = student.as_ref().unwrap_or(&case.right);
    let amiss = |index: &usize| matches!(judgement.verdicts[*index], Verdict::Wrong | Verdict::Consistent);
    let (mut own, mut spots) = (Own::default(), vec![None; judgement.verdicts.len()]);
    for index in (0..judgement.verdicts.len()).filter(amiss) {
        if let Some((quantity, at, right)) = case.place_handed_in(index) {
            own.places.push((quantity, at, right));
            spots[index] = Some(Spot::In(DiagramKind::Skeleton, at));
        }
        let forces = case.force_handed_in(index);
        if !forces.is_empty() {
            spots[index] = Some(Spot::Force(own.forces.len()));
            own.forces.extend(forces);
        }
    }
    let are_right = (0..judgement.verdicts.len()).filter(|&i| judgement.verdicts[i] == Verdict::Right);
    let figures = own::Figures::new(&case, student, &judgement.verdicts);
    figures.add_to(&mut own);
    own.right_forces = are_right.flat_map(|index| case.force_handed_in(index)).collect();
    // What is right as far as it can be measured stands elsewhere all the same: of two centres interchanged both are shown.
    let off = |index: &usize| {
        let miss = || case.miss(*index, case.truth[*index].as_deref(), case.rooms[*index]);
        !amiss(index) && judgement.verdicts[*index] == Verdict::Right && miss() > 1.0
    };
    let beside = (0..judgement.verdicts.len()).filter(off).filter_map(|index| case.place_handed_in(index));
    if !own.places.is_empty() {
        own.places.extend(beside);
    }
    let named: Vec<String> = report
        .quantities
        .iter()
        .filter(|graded| graded.verdict == Verdict::Wrong)
        .enumerate()
        .map(|(place, graded)| {
            let fault = FirstFault { step: graded.step, name: &graded.name, mistakes: &graded.mistakes };
            let told = if place == 0 { say!("First fault, {}", fault.text()) } else { fault.text() };
            report.says(&told)
        })
        .collect();
    let faults: Vec<crate::sheet::Fault<'_>> = judgement
        .faults
        .iter()
        .zip(&named)
        .filter_map(|(fault, text)| {
            let place = || figures.place(fault.first).map(|(order, at)| Spot::In(order.diagram(), at));
            let at = spots[fault.first].or_else(place)?;
            Some(crate::sheet::Fault { at, text })
        })
        .collect();
    // What is wrong may show nowhere in a figure: nobody looks for it there.
    let is_wrong = judgement.verdicts.contains(&Verdict::Wrong);
    let nothing = own.vectors.is_empty()
        && !own.points.iter().any(|point| point.amiss)
        && own.places.is_empty()
        && own.forces.is_empty();
    if is_wrong
        && faults.is_empty()
        && nothing
        && same_figures(&case.right.construction, &student.construction)
    {
        return Ok((report, None));
    }
    // A polygon of which nothing was answered is not laid under anything.
    let mut right = case.right.construction.clone();
    for order in [Order::Velocity, Order::Acceleration] {
        if !case.draws(order) {
            right.diagrams.retain(|diagram| diagram.kind != order.diagram());
        }
    }
    let (balance, drawn) = (case.balance(), (&student.construction, &own));
    let told = (&faults[..], settings.language);
    let left = settings.printed.then(|| report.leaves_of_page());
    let figure = crate::sheet::overlay(scene, &right, drawn, balance, told, left);
    Ok((report, figure))
}

/// Whether the points of all polygons stand at the same places.
fn same_figures(right: &Construction, student: &Construction) -> bool {
    right.diagrams.iter().all(|diagram| {
        student.diagram(diagram.kind).is_some_and(|own| {
            let mut points = diagram.images.iter().zip(&own.images);
            diagram.images.len() == own.images.len()
                && points.all(|(a, b)| a.label == b.label && a.at == b.at)
        })
    })
}

/// What may be said of a problem before anybody answers it: of every asked quantity what is right, and by how much an
/// answer may be off. An asked quantity whose [`Allowed`] is [`Allowed::Capped`] is one that a careful hand may miss.
///
/// # Errors
/// See [`GradeError`].
pub fn tolerances(scene: &Scene, settings: &GradeSettings) -> Result<Vec<Graded>, GradeError> {
    let answers = Answers::of_asked(scene);
    let case = case::Case::new(scene, &answers, settings)?;
    let verdicts = vec![Verdict::NotChecked; case.observations.len()];
    let judgement = judge::Judgement {
        caused: vec![None; verdicts.len()],
        verdicts,
        faults: Vec::new(),
        drawn: change::Change::default(),
    };
    Ok(report::report(&case, &answers, &judgement).quantities)
}
