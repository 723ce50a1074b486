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
mod case;
mod change;
mod csv;
mod drawing;
mod judge;
mod kind;
mod mistakes;
mod nearest;
mod report;
mod scan;
mod schema;
mod weight;

pub use answers::{Answers, FigurePoints, Given, Item, StatedScales, Tolerance, read_answers, read_named};
pub use judge::{Mistake, Verdict};
pub use kind::Kind;
pub use report::{FirstFault, Graded, Report};
pub use scan::Scan;
pub use schema::schema;

use crate::board::Hand;
use crate::check::Unconfirmed;
use crate::scene::{Diagnostic, Scene};
use crate::sheet::Figure;
use crate::solve::SolveError;

/// How to grade.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GradeSettings {
    /// How exact a hand is expected, where the answers do not say it.
    pub hand: Hand,
    /// How many draughtsmen draw it for the tolerances.
    pub draughtsmen: u64,
}

impl Default for GradeSettings {
    fn default() -> Self {
        Self { hand: Hand { length: 0.2, angle: 0.3_f64.to_radians() }, draughtsmen: 96 }
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

/// Grades the answers to a scene.
///
/// # Errors
/// See [`GradeError`].
pub fn grade(scene: &Scene, answers: &Answers, settings: &GradeSettings) -> Result<Report, GradeError> {
    let case = case::Case::new(scene, answers, settings)?;
    let judgement = judge::judge(&case);
    Ok(report::report(&case, answers, &judgement))
}

/// As [`grade`], with the student's polygons, as far as the answers tell of them, thin over the right ones; the
/// first fault is circled and named. No figure where nothing that was answered needs a polygon.
///
/// # Errors
/// See [`GradeError`].
pub fn grade_with_overlay(
    scene: &Scene,
    answers: &Answers,
    settings: &GradeSettings,
) -> Result<(Report, Option<Figure>), GradeError> {
    let case = case::Case::new(scene, answers, settings)?;
    let judgement = judge::judge(&case);
    let report = report::report(&case, answers, &judgement);
    let student = case.drawn(&judgement.drawn, None);
    let student = student.as_ref().unwrap_or(&case.right);
    let text = report.first_fault().map(|fault| format!("First fault, {}", fault.text()));
    let place = judgement.faults.first().and_then(|fault| case.place_of(fault.first, student));
    let fault = text.as_deref().zip(place).map(|(text, (order, at))| crate::sheet::Fault { order, at, text });
    let figure = crate::sheet::overlay(scene, &case.right.construction, &student.construction, fault);
    Ok((report, figure))
}
