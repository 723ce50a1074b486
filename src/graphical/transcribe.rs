//! A mechanism's drawing as a program: made once, to be run over the range of an input.

use crate::board::{Board, BoundedProgram, Equipped, Program, Reason, Transcript, Variable};
use crate::mechanism::structure::{GroupKind, Structure};
use crate::mechanism::{LinkId, Mechanism};
use crate::plan::Plan;

use super::draughtsman::Draughtsman;
use super::reading::read_all;
use super::rolled::Starts;
use super::{DrawError, Scales, drawn_by};

/// A transcribed drawing and what its numbers mean.
#[derive(Debug, Clone)]
pub struct Transcribed {
    /// The program, with every divisor that must not vanish; its asked numbers are those of the asked
    /// quantities one after the other.
    pub program: Program,
    /// The same for the first asked quantities only and without divisors: what a sweep runs.
    pub lean: Program,
    /// How many numbers each asked quantity has; none for what has no meaning here.
    pub numbers: Vec<usize>,
    /// Link numbers behind each reason of a divisor.
    pub reasons: Vec<Vec<u32>>,
    /// The circle diagram leads to not every wanted centre: plan again with velocities.
    pub stalled: bool,
    /// Which chord of the program every half chord of the drawing is, in the order of drawing.
    chord_calls: Vec<Option<u32>>,
}

/// A transcribed drawing with bounds of its first asked numbers.
#[derive(Debug, Clone)]
pub struct TranscribedWithBounds {
    /// The program.
    pub program: BoundedProgram,
    /// The chord of [`Transcribed::program`] that each of its chords is; `None` for one that is constant there.
    pub chords: Vec<Option<usize>>,
}

impl Transcribed {
    /// The links that stand in line where a divisor of this reason vanishes.
    #[must_use]
    pub fn links(&self, reason: Reason) -> &[u32] {
        self.reasons.get(reason as usize).map_or(&[], Vec::as_slice)
    }
}

/// Draws the mechanism once, at the place of its inputs, and writes the drawing down as a program of what is
/// varied; `lean` of the asked quantities are wanted for every position; `starts` says where points of wheels stand
/// in it, empty where no wheel has points. Paper and reality have the same scale: nobody looks at this drawing.
///
/// # Errors
/// See [`DrawError`]; [`DrawError::NoConstruction`] for groups of higher class, whose trials are not steps of
/// fixed number.
pub fn transcribe(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    (variable, lean): (Variable, usize),
    starts: &Starts,
) -> Result<Transcribed, DrawError> {
    let written = write_down(Transcript::of(variable), mechanism, structure, plan, starts)?;
    let few = written.numbers.iter().take(lean).sum::<usize>().min(written.asked.len());
    Ok(Transcribed {
        program: written.transcript.program(&written.asked, true),
        lean: written.transcript.program(&written.asked[..few], false),
        numbers: written.numbers,
        reasons: written.reasons,
        stalled: written.stalled,
        chord_calls: written.transcript.chord_calls().to_vec(),
    })
}

/// The same drawing as `of`, written down with the errors of its numbers, for the first `lean` asked quantities.
///
/// # Errors
/// As [`transcribe`].
pub fn transcribe_with_bounds(
    of: &Transcribed,
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    (variable, lean): (Variable, usize),
) -> Result<TranscribedWithBounds, DrawError> {
    let written = write_down(Transcript::with_errors(variable), mechanism, structure, plan, &[])?;
    let few = written.numbers.iter().take(lean).sum::<usize>().min(written.asked.len());
    let calls = written.transcript.chord_calls();
    let count = calls.iter().flatten().max().map_or(0, |last| last + 1);
    let chords = (0..count)
        .map(|chord| {
            let call = calls.iter().position(|c| *c == Some(chord))?;
            of.chord_calls.get(call).copied().flatten().map(|c| c as usize)
        })
        .collect();
    Ok(TranscribedWithBounds { program: written.transcript.bounded(&written.asked[..few]), chords })
}

/// What a transcript holds when the drawing is finished.
struct Written {
    transcript: Transcript,
    numbers: Vec<usize>,
    asked: Vec<u32>,
    reasons: Vec<Vec<u32>>,
    stalled: bool,
}

fn write_down(
    transcript: Transcript,
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    starts: &Starts,
) -> Result<Written, DrawError> {
    let higher = plan
        .position
        .iter()
        .map(|step| &structure.groups[step.group])
        .find(|group| matches!(group.kind, GroupKind::Higher { .. } | GroupKind::Other));
    if let Some(group) = higher {
        let links: Vec<LinkId> = group.links.clone();
        return Err(DrawError::NoConstruction { links });
    }
    let scales = Scales { length: 1.0, velocity: 1.0, acceleration: 1.0 };
    let board = Board::<Equipped<f64, Transcript>>::new(transcript);
    let mut draughtsman = Draughtsman::new(board, mechanism, structure, scales);
    draughtsman.starts = starts;
    let mut draughtsman = drawn_by(draughtsman, plan)?;
    let readings = read_all(&mut draughtsman);
    // What lies at infinity in this drawing has a direction, and no place to go on from.
    let marks: Vec<Vec<u32>> = readings
        .iter()
        .map(|read| match (&read.numbers, read.toward) {
            (Ok(numbers), None) => numbers.iter().map(|(mark, _)| *mark).collect(),
            _ => Vec::new(),
        })
        .collect();
    let numbers = marks.iter().map(Vec::len).collect();
    let asked = marks.concat();
    let stalled = draughtsman.record().circle.as_ref().is_some_and(|circle| !circle.stalled.is_empty());
    let reasons = draughtsman.all_reasons();
    let transcript = std::mem::take(draughtsman.board.recorder());
    Ok(Written { transcript, numbers, asked, reasons, stalled })
}
