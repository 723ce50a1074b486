//! A mechanism's drawing as a program: made once, to be run over the range of an input.

use crate::board::{Board, Equipped, Program, Reason, Transcript};
use crate::mechanism::structure::{GroupKind, Structure};
use crate::mechanism::{LinkId, Mechanism};
use crate::plan::Plan;

use super::reading::read_all;
use super::{DrawError, Scales, draw};

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
}

impl Transcribed {
    /// The links that stand in line where a divisor of this reason vanishes.
    #[must_use]
    pub fn links(&self, reason: Reason) -> &[u32] {
        self.reasons.get(reason as usize).map_or(&[], Vec::as_slice)
    }
}

/// Draws the mechanism once, at the place of its inputs, and writes the drawing down as a program of the
/// input `swept`; `lean` of the asked quantities are wanted for every position. Paper and reality have the same scale: nobody looks at this drawing.
///
/// # Errors
/// See [`DrawError`]; [`DrawError::NoConstruction`] for groups of higher class, whose trials are not steps of
/// fixed number.
pub fn transcribe(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    (swept, lean): (usize, usize),
) -> Result<Transcribed, DrawError> {
    let higher = plan.position.iter().map(|step| &structure.groups[step.group]).find(|group| {
        matches!(group.kind, GroupKind::Higher { .. } | GroupKind::TrialDriver { .. } | GroupKind::Other)
    });
    if let Some(group) = higher {
        let links: Vec<LinkId> = group.links.clone();
        return Err(DrawError::NoConstruction { links });
    }
    let scales = Scales { length: 1.0, velocity: 1.0, acceleration: 1.0 };
    let board = Board::<Equipped<f64, Transcript>>::new(Transcript::of_input(swept));
    let mut draughtsman = draw(board, mechanism, structure, plan, scales)?;
    let readings = read_all(&mut draughtsman);
    let numbers: Vec<usize> = readings.iter().map(|read| read.numbers.as_ref().map_or(0, Vec::len)).collect();
    let asked: Vec<u32> =
        readings.iter().flat_map(|read| read.numbers.iter().flatten().map(|(mark, _)| *mark)).collect();
    let reasons = draughtsman.all_reasons();
    let transcript = std::mem::take(draughtsman.board.recorder());
    let few = numbers.iter().take(lean).sum::<usize>().min(asked.len());
    Ok(Transcribed {
        program: transcript.program(&asked, true),
        lean: transcript.program(&asked[..few], false),
        numbers,
        reasons,
    })
}
