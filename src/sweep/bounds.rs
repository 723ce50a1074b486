//! Positions of a sweep with a bound for every number.

use super::{Sweep, SweepError};
use crate::board::{FEW, FoundByTrial, Workspace};
use crate::graphical::{TranscribedWithBounds, transcribe_with_bounds};
use crate::mechanism::structure::Structure;
use crate::plan::{Extent, Plan};

/// The place of a position counts as uncertain by half a unit in its last place, and by as much again for its
/// unit, as a number of the scene does.
const OF_PLACE: f64 = f64::EPSILON;

/// A sweep that bounds the numbers that were asked for.
#[derive(Debug, Clone)]
pub struct SweepWithBounds<'s> {
    sweep: &'s Sweep,
    transcribed: TranscribedWithBounds,
}

impl Sweep {
    /// The same sweep with a bound for every asked number of every position: half a unit in the last place of every
    /// number of the scene and of the place, and every operation since.
    ///
    /// # Errors
    /// As [`Sweep::new`], which has drawn the same drawing.
    pub fn with_bounds(&self) -> Result<SweepWithBounds<'_>, SweepError> {
        if self.is_carried_along() {
            return Err(SweepError::Instant(
                "no bounds where points of a wheel are asked for: what it has rolled adds up from the scene's \
                 instant on"
                    .to_owned(),
            ));
        }
        let (mechanism, variable, source) = &self.ready;
        let structure = Structure::of(mechanism)?;
        let plan = Plan::with(mechanism, &structure, Extent::Asked, *source);
        let asked = (variable.clone(), self.asked);
        let transcribed = transcribe_with_bounds(&self.transcribed, mechanism, &structure, &plan, asked)?;
        Ok(SweepWithBounds { sweep: self, transcribed })
    }
}

impl SweepWithBounds<'_> {
    /// How many operations one position takes, without its bounds.
    #[must_use]
    pub fn operations(&self) -> usize {
        self.transcribed.program.len()
    }

    /// Computes the asked columns at many places, ascending, a few at a time and without allocation for each: `take`
    /// gets the place, its numbers and their bounds. Where a number is not determined its bound is infinite.
    pub fn run(&self, places: &[f64], take: impl FnMut(f64, &[f64], &[f64])) {
        self.run_within(places, |at| OF_PLACE * at.abs(), take);
    }

    /// The same where each place is known within an error of its own, rad or m.
    pub fn run_within(
        &self,
        places: &[f64],
        error: impl Fn(f64) -> f64,
        mut take: impl FnMut(f64, &[f64], &[f64]),
    ) {
        let TranscribedWithBounds { program, chords, turns } = &self.transcribed;
        let before_turns = self.sweep.transcribed().program.chord_count();
        let mut block = program.block();
        let mut place = Workspace::default();
        let width = self.sweep.columns.iter().filter(|c| !c.watched).count();
        let (mut row, mut bounds) = (vec![0.0; width], vec![0.0; width]);
        for (stretch, inside) in self.sweep.parts(places) {
            let own = &stretch.signs;
            let mut signs: Vec<f64> = chords
                .iter()
                .map(|chord| chord.and_then(|c| stretch.signs.get(c).copied()).unwrap_or(1.0))
                .collect();
            signs.resize(program.chord_slots(), 1.0);
            signs.extend(turns.iter().map(|turn| {
                turn.and_then(|turn| stretch.signs.get(before_turns + turn).copied()).unwrap_or(0.0)
            }));
            for chunk in inside.chunks(FEW) {
                let mut at = [chunk.last().copied().unwrap_or(0.0); FEW];
                at[..chunk.len()].copy_from_slice(chunk);
                let errors = at.map(&error);
                let mut found: [Vec<FoundByTrial>; FEW] = Default::default();
                if self.sweep.tries() {
                    for (found, &at) in found.iter_mut().zip(&at) {
                        self.sweep.transcribed().lean.look(at, own, &mut place);
                        *found = place.found().to_vec();
                    }
                }
                program.run(&at, &errors, (&signs, &found), &mut block);
                for (index, &at) in chunk.iter().enumerate() {
                    let ambiguous = self.sweep.is_ambiguous(at);
                    let found = block.asked(program).zip(&self.sweep.columns);
                    for ((to, bound), ((value, within), column)) in row.iter_mut().zip(&mut bounds).zip(found)
                    {
                        *to = if column.is_unsigned() { value[index].abs() } else { value[index] };
                        *bound =
                            if ambiguous && column.is_of_balance() { f64::INFINITY } else { within[index] };
                    }
                    take(at, &row, &bounds);
                }
            }
        }
    }
}
