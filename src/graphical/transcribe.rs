//! A mechanism's drawing as a program: made once, to be run over the range of an input.

use crate::board::{Board, BoundedProgram, Program, Reason, Tape, Transcript, Variable, Wanted};
use crate::given::Given;
use crate::mechanism::quantity::{Order, Quantity, Stuck};
use crate::mechanism::structure::{GroupKind, Structure};
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::plan::{Plan, chord};

use super::draughtsman::Draughtsman;
use super::reading::read_all;
use super::rolled::Starts;
use super::{DrawError, Scales, board_scales, drawn_by};

/// A transcribed drawing and what its numbers mean.
#[derive(Debug, Clone)]
pub struct Transcribed {
    /// The program, with every divisor that must not vanish; its asked numbers are those of the asked
    /// quantities one after the other, then for each of `centres` its reach and its weight.
    pub program: Program,
    /// The same for the first asked quantities only and without divisors: what a sweep runs.
    pub lean: Program,
    /// Where points stand: the coordinates of those of `placed`, one after the other; by what angle those of
    /// `turned` have turned; and where the x-axes of those of `swivelling` point, as cosine and sine.
    pub skeleton: Program,
    /// The points that the drawing places.
    pub placed: Vec<PointId>,
    /// The wheels that roll on from where they stand in the drawing.
    pub turned: Vec<LinkId>,
    /// The links of one joint that swivel with the rider of their guide.
    pub swivelling: Vec<LinkId>,
    /// How many numbers each asked quantity has; none for what has none.
    pub numbers: Vec<usize>,
    /// The asked quantities, by index, that are instant centres with a place: each has two numbers, and three
    /// homogeneous coordinates that tell when it lies at infinity.
    pub centres: Vec<usize>,
    /// Why an asked quantity has no numbers, by index.
    pub without: Vec<(usize, Without)>,
    /// Link numbers behind each reason of a divisor.
    pub reasons: Vec<Vec<u32>>,
    /// How friction is stuck behind each, where it is that.
    pub stuck: Vec<Option<Stuck>>,
    /// The circle diagram leads to not every wanted centre: plan again with velocities.
    pub stalled: bool,
    /// Which chord of the program every half chord of the drawing is, in the order of drawing.
    chord_calls: Vec<Option<u32>>,
    /// Which of the angles that go on every one of the drawing is.
    turn_calls: Vec<Option<u32>>,
}

/// Why a quantity has no numbers in a transcribed drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Without {
    /// An instant centre that is at infinity in every position.
    AtInfinity,
    /// It is not determined, for this reason.
    Undefined(&'static str),
}

/// A transcribed drawing with bounds of its first asked numbers.
#[derive(Debug, Clone)]
pub struct TranscribedWithBounds {
    /// The program.
    pub program: BoundedProgram,
    /// The chord of [`Transcribed::program`] that each of its chords is; `None` for one that is constant there.
    pub chords: Vec<Option<usize>>,
    /// The same of the angles that go on.
    pub turns: Vec<Option<usize>>,
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
/// in it, empty where no wheel has points. Paper and reality have the same scale where nobody looks at this drawing.
///
/// # Errors
/// See [`DrawError`].
pub fn transcribe(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    (variable, lean): (Variable, usize),
    starts: &Starts,
) -> Result<Transcribed, DrawError> {
    let written = write_down(|tape| Transcript::of(tape, variable), mechanism, structure, plan, starts)?;
    let wanted: Vec<Wanted> = written.wanted(mechanism).collect();
    let few = written.numbers.iter().take(lean).sum::<usize>().min(wanted.len());
    let all: Vec<Wanted> = wanted
        .iter()
        .copied()
        .chain(written.homogeneous.iter().flatten().map(|&slot| Wanted { slot, of_motion: false }))
        .collect();
    let places: Vec<Wanted> = written.places.iter().map(|&slot| Wanted { slot, of_motion: true }).collect();
    Ok(Transcribed {
        skeleton: written.transcript.program(&places, false),
        placed: written.placed,
        turned: written.turned,
        swivelling: written.swivelling,
        program: written.transcript.program(&all, true),
        lean: written.transcript.program(&wanted[..few], false),
        numbers: written.numbers,
        centres: written.centres,
        without: written.without,
        reasons: written.reasons,
        stuck: written.stuck,
        stalled: written.stalled,
        chord_calls: written.transcript.chord_calls().to_vec(),
        turn_calls: written.transcript.turn_calls().to_vec(),
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
    let written =
        write_down(|tape| Transcript::with_errors(tape, variable), mechanism, structure, plan, &[])?;
    let few = written.numbers.iter().take(lean).sum::<usize>().min(written.asked.len());
    let chords = one_in_the_other(written.transcript.chord_calls(), &of.chord_calls);
    let turns = one_in_the_other(written.transcript.turn_calls(), &of.turn_calls);
    Ok(TranscribedWithBounds { program: written.transcript.bounded(&written.asked[..few]), chords, turns })
}

/// Of everything that is numbered in one transcript its number in the other, by what was drawn first of it.
fn one_in_the_other(calls: &[Option<u32>], others: &[Option<u32>]) -> Vec<Option<usize>> {
    let count = calls.iter().flatten().max().map_or(0, |last| last + 1);
    let of = |number: u32| {
        let call = calls.iter().position(|c| *c == Some(number))?;
        others.get(call).copied().flatten().map(|c| c as usize)
    };
    (0..count).map(of).collect()
}

/// What a transcript holds when the drawing is finished.
struct Written {
    transcript: Transcript,
    numbers: Vec<usize>,
    asked: Vec<u32>,
    placed: Vec<PointId>,
    turned: Vec<LinkId>,
    swivelling: Vec<LinkId>,
    /// Of each of the placed points, of each of the wheels, and of each of those that swivel.
    places: Vec<u32>,
    centres: Vec<usize>,
    /// Of each of the centres.
    homogeneous: Vec<[u32; 3]>,
    without: Vec<(usize, Without)>,
    reasons: Vec<Vec<u32>>,
    stuck: Vec<Option<Stuck>>,
    stalled: bool,
}

impl Written {
    /// The asked numbers. Of a centre the mechanism does not depend: it is drawn onto the skeleton.
    fn wanted<'a>(&'a self, mechanism: &'a Mechanism) -> impl Iterator<Item = Wanted> + 'a {
        let of_motion = mechanism
            .asked
            .iter()
            .zip(&self.numbers)
            .flat_map(|(asked, &count)| vec![!matches!(asked.quantity, Quantity::Centre(..)); count]);
        self.asked.iter().zip(of_motion).map(|(&slot, of_motion)| Wanted { slot, of_motion })
    }
}

fn write_down(
    read: impl FnOnce(&Tape) -> Transcript,
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    starts: &Starts,
) -> Result<Written, DrawError> {
    let groups = || plan.steps(Order::Position).iter().map(|step| &structure.groups[step.group]);
    if let Some(group) = groups().find(|group| group.kind == GroupKind::Other) {
        let links: Vec<LinkId> = group.links.clone();
        return Err(DrawError::NoConstruction { links });
    }
    // Trials are looked at: how near a place is to another, and whether a miss is small, is measured on paper.
    let tries = groups().any(|group| matches!(group.kind, GroupKind::Higher { .. }));
    let scales = if tries { board_scales(mechanism, structure, plan) } else { Scales::new(|_| 1.0) };
    let board = Board::new(Tape::to_be_run());
    let mut draughtsman = Draughtsman::new(board, mechanism, structure, scales);
    draughtsman.starts = starts;
    let mut draughtsman = drawn_by(draughtsman, plan)?;
    let readings = read_all(&mut draughtsman);
    let read_off: Vec<Result<ReadNumbers, Without>> = readings
        .iter()
        .zip(&mechanism.asked)
        .map(|(read, asked)| match (&read.numbers, asked.quantity) {
            (Err(why), _) => Err(Without::Undefined(why)),
            (Ok(_), Quantity::Centre(i, j)) => centre(&mut draughtsman, [i, j]),
            (Ok(numbers), _) => {
                Ok(ReadNumbers { marks: numbers.iter().map(|(mark, _)| *mark).collect(), homogeneous: None })
            }
        })
        .collect();
    let (mut placed, mut places) = (Vec::new(), Vec::new());
    for point in (0..mechanism.points.len()).map(PointId) {
        // A point of a link that stands is on it, though nobody asked for it: where the scene has it roughly is long past.
        if let Some(at) = draughtsman.place_by_places(point) {
            placed.push(point);
            places.extend(draughtsman.in_world(at).map(|amount| amount.mark()));
        }
    }
    let mut turned = Vec::new();
    for link in (0..mechanism.links.len()).map(LinkId) {
        if let Some(by) = draughtsman.turned_by[link.0] {
            turned.push(link);
            places.push(draughtsman.board.radians(by).mark());
        }
    }
    let mut swivelling = Vec::new();
    for link in (0..mechanism.links.len()).map(LinkId) {
        if draughtsman.swivels_by(link).is_some() && draughtsman.pose_of(link).is_some() {
            let own_x = draughtsman.board.rightward();
            let along = draughtsman.carried(link, own_x);
            let unit = draughtsman.board.amount(Given::exact(1.0));
            swivelling.push(link);
            places.extend(draughtsman.board.components(along, unit).map(|part| part.mark()));
        }
    }
    let stalled = draughtsman.record().circle.as_ref().is_some_and(|circle| !circle.stalled.is_empty());
    let (reasons, stuck) = (draughtsman.all_reasons(), draughtsman.all_stuck());
    let transcript = read(draughtsman.board.tape());
    let places = places.into_iter().map(|mark| transcript.slot(mark)).collect();
    let (mut numbers, mut asked) = (Vec::new(), Vec::new());
    let (mut centres, mut homogeneous, mut without) = (Vec::new(), Vec::new(), Vec::new());
    for (index, read) in read_off.into_iter().enumerate() {
        let read = read.and_then(|read| {
            let coordinates = read.homogeneous.map(|marks| marks.map(|mark| transcript.slot(mark)));
            match coordinates {
                Some([.., weight]) if transcript.constant_at(weight) == Some(0.0) => Err(Without::AtInfinity),
                coordinates => Ok((read.marks, coordinates)),
            }
        });
        match read {
            Ok((marks, coordinates)) => {
                if let Some(coordinates) = coordinates {
                    centres.push(index);
                    homogeneous.push(coordinates);
                }
                numbers.push(marks.len());
                asked.extend(marks.into_iter().map(|mark| transcript.slot(mark)));
            }
            Err(why) => {
                numbers.push(0);
                without.push((index, why));
            }
        }
    }
    Ok(Written {
        transcript,
        numbers,
        asked,
        placed,
        turned,
        swivelling,
        places,
        centres,
        homogeneous,
        without,
        reasons,
        stuck,
        stalled,
    })
}

/// Where an asked quantity stands on the tape.
struct ReadNumbers {
    marks: Vec<u32>,
    /// Of an instant centre: its reach and its weight.
    homogeneous: Option<[u32; 3]>,
}

/// The place of an instant centre, and its reach and weight: whether it lies at infinity in this position must not
/// decide how it is written down.
fn centre(d: &mut Draughtsman<'_>, links: [LinkId; 2]) -> Result<ReadNumbers, Without> {
    let Some(&centre) = d.centres.known.get(&chord(links[0], links[1])) else {
        return Err(Without::Undefined("no construction leads to this centre"));
    };
    let reason = d.reason(&links);
    let (at, reach, weight) = d.board.coordinates(centre, reason);
    let marks = d.in_world(at).map(|amount| amount.mark()).to_vec();
    Ok(ReadNumbers { marks, homogeneous: Some([reach[0].mark(), reach[1].mark(), weight.mark()]) })
}
