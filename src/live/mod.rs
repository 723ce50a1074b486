//! The live page: a scene's drawing, written down so that a browser can run it.
//!
//! The page holds the transcribed drawing (a list of operations), the course as the sweep found it, and what of the
//! sheet's ink hangs on which numbers. Its script runs the operations and moves the ink; it knows no mechanism.
//!
//! **Architecture Invariant:** no arithmetic of kinematics here: every number comes from the program of a
//! [`Sweep`], every stroke from `sheet/`.

mod course;
mod diagrams;
mod hash;
mod moves;
mod page;
mod program;
mod said;
mod schema;
mod shown;
mod words;

use serde_json::{Value, json};
use thiserror::Error;

use crate::board::Listing;
use crate::mechanism::quantity::{Quantity, Stuck};
use crate::plan::Extent;
use crate::scene::Scene;
use crate::sheet::Language;
use crate::solve::{SolveError, Solved, solve};
use crate::sweep::{Over, Sweep, SweepError};

pub use page::{Options, page, question};
pub use schema::schema;

/// The name of the format.
pub const FORMAT: &str = "linkgram-live";
/// Its version: a page refuses others.
pub const VERSION: u32 = 1;

/// Angles beyond this many radians are reduced by a routine that pages do not have.
const LARGEST_ANGLE: f64 = 1e6;

/// Why a scene cannot be written down to be run.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum LiveError {
    /// The scene has no solution.
    #[error(transparent)]
    Unsolved(#[from] SolveError),
    /// It cannot be swept.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// A number on the way is none, or the range is beyond what pages reckon with.
    #[error("{0}")]
    Number(&'static str),
}

/// A scene's drawing as a page runs it.
#[derive(Debug, Clone)]
pub struct Live<'s> {
    scene: &'s Scene,
    over: Over,
    sweep: Sweep,
    listing: Listing,
}

impl<'s> Live<'s> {
    /// Draws the scene, writes the drawing down and walks its course. `range` is in SI units, as for a sweep.
    ///
    /// # Errors
    /// See [`LiveError`].
    pub fn of(scene: &'s Scene, over: Over, range: Option<[f64; 2]>) -> Result<Self, LiveError> {
        let solved = solve(scene, Extent::WholeSkeleton, crate::sheet::scale::for_scene)?;
        Self::of_solved(scene, &solved, over, range)
    }

    /// The same of a scene that is solved.
    ///
    /// # Errors
    /// See [`LiveError`].
    pub fn of_solved(
        scene: &'s Scene,
        solved: &Solved,
        over: Over,
        range: Option<[f64; 2]>,
    ) -> Result<Self, LiveError> {
        let also = shown::besides(scene, solved, over);
        let sweep = Sweep::showing(over, &scene.mechanism, range, &also)?;
        let listing = sweep.listing();
        if !listing.constants.iter().all(|(_, value, _)| value.is_finite()) {
            return Err(LiveError::Number("a number of the drawing is too large to be written down"));
        }
        if over == Over::Input && sweep.range.iter().any(|end| end.abs() > LARGEST_ANGLE) {
            return Err(LiveError::Number("the range of the input lies beyond a million radians"));
        }
        Ok(Self { scene, over, sweep, listing })
    }

    /// The sweep behind it: its columns are the outputs, in order.
    #[must_use]
    pub fn sweep(&self) -> &Sweep {
        &self.sweep
    }

    /// The whole as `linkgram-live` JSON: what a page holds, without its ink.
    #[must_use]
    pub fn json(&self, language: Language) -> Value {
        let mut data = json!({
            "format": FORMAT,
            "version": VERSION,
            "program_version": env!("CARGO_PKG_VERSION"),
            "language": language.words().tag,
            "variable": course::variable(self.scene, &self.sweep, self.over),
            "program": program::json(&self.listing),
            "course": course::json(&self.sweep),
            "outputs": self.outputs(),
            "behind": program::behind(&self.listing),
            "reasons": self.sweep.reasons(),
        });
        let word = |stuck: &Option<Stuck>| {
            stuck.map(|stuck| match stuck {
                Stuck::AtRest => "at_rest",
                Stuck::Locked | Stuck::Ambiguous => "locked",
            })
        };
        let stuck: Vec<Option<&str>> = self.sweep.stuck().iter().map(word).collect();
        if stuck.iter().any(Option::is_some) {
            data["stuck"] = json!(stuck);
        }
        data
    }

    /// What the data of the ink call a quantity.
    fn name_in_ink(&self, quantity: Quantity) -> String {
        quantity.name(&self.scene.mechanism)
    }

    fn outputs(&self) -> Vec<Value> {
        let rows = &self.listing.asked;
        self.sweep
            .columns
            .iter()
            .zip(rows)
            .map(|(column, row)| {
                let mut output = json!({
                    "row": row,
                    "name": column.asked.name,
                    "axis": column.axis,
                    "unit": column.asked.unit.symbol,
                    "si": column.asked.unit.si,
                    "asked": !column.watched,
                });
                // What holds of few is said of these alone: a page has no room to spare.
                for (name, holds) in
                    [("unsigned", column.is_unsigned()), ("of_position", column.is_of_position())]
                {
                    if holds {
                        output[name] = holds.into();
                    }
                }
                output
            })
            .collect()
    }
}
