//! The method: position, velocity polygon, acceleration polygon, written in the board's operations.
//!
//! **Architecture Invariant:** nothing here knows `nalgebra` or the analytic solver; every direction,
//! intersection and unknown length is drawn on the board and read off it. Between reading and laying off
//! stands only what the textbook calculates: V = ωl, ω = V/l, Aⁿ = V²/l, Aᵗ = εl, ε = Aᵗ/l, scales.

mod acceleration;
pub mod auxiliary;
mod by_hand;
mod centres;
pub mod centrodes;
pub mod construction;
mod curve;
pub mod cycle;
pub mod cycle_by_hand;
mod departure;
mod draughtsman;
mod dyad;
mod far_end;
mod figure;
mod forces;
mod link_figure;
mod loci;
mod missing;
mod page;
mod pinned_rack;
mod pose;
mod position;
mod reading;
mod rolled;
mod scales;
mod settle;
mod shown;
mod transcribe;
mod trial;
mod velocity;
mod verify;

pub use by_hand::{Draughtsmen, HandError, Slip, Slips, Spread, by_hand, by_one_hand, errors_of};
pub use departure::{Departure, Sketch, Twist, free_bodies, sketch};
pub(crate) use figure::standing;
pub(crate) use forces::holds;
pub use missing::Missing;
pub use page::is_a_point;
pub use reading::Numbers;
pub use scales::{DiagramExtent, Extents, Paper, Scales};
pub use shown::{Shown, is_trial};
pub use transcribe::{Transcribed, TranscribedWithBounds, Without, transcribe, transcribe_with_bounds};
pub use trial::Searched;

use std::collections::HashSet;

use crate::board::{Arithmetic, Board, Real, Scale, Tape};
use crate::given::Given;
use crate::mechanism::quantity::{Dimension, Order, Quantity};
use crate::mechanism::structure::{Drive, GroupKind, Structure};
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::{Extent, Plan};
use construction::Construction;
use draughtsman::Draughtsman;
use scales::{board_scales, measure, planned_scales, provisional_scales};

/// A finished drawing and the tape behind it.
#[derive(Debug, Clone)]
pub struct Solution {
    /// What stands on the paper.
    pub construction: Construction,
    /// The tape, for sensitivities.
    pub tape: Tape,
    /// Tape slots of each answer: two for a vector, one for a scalar, none where it needs none.
    pub slots: Vec<Vec<u32>>,
    /// Everything that stands on the paper, asked or not.
    pub shown: Vec<Shown>,
    /// The lines of the forces among these and of the asked ones, each as its moment about one place.
    pub lines: Vec<Shown>,
}

impl Solution {
    /// The extents without those of a polygon in which nothing is clear of zero: its scale would be that of roundings.
    /// `None` where there is no such polygon.
    #[must_use]
    pub fn without_noise(&self, extents: &Extents) -> Option<Extents> {
        let mut quiet = extents.clone();
        let mut found = false;
        for extent in quiet.diagrams.iter_mut().filter(|extent| extent.size != [0.0; 2]) {
            let drawn = self.construction.diagram(extent.kind);
            let vectors = || drawn.iter().flat_map(|diagram| &diagram.vectors).filter(|v| !is_trial(v));
            if vectors().next().is_some() && vectors().all(|v| v.is_zero) {
                extent.size = [0.0; 2];
                found = true;
            }
        }
        found.then_some(quiet)
    }
}

/// Why the skeleton cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum DrawError {
    /// Two arcs, or an arc and a guide, do not meet.
    #[error("cannot be assembled: {why}")]
    CannotAssemble {
        /// The pin that cannot be reached.
        pin: PointId,
        /// Which sum fails, in the mechanism's own names; lengths in metres.
        why: Box<Misfit>,
        /// For which input the chain closes, where that could be found.
        range: Option<ClosingRange>,
    },
    /// Two assemblies and nothing to choose by.
    #[error("ambiguous: the chain closes in two ways and nothing chooses between them")]
    Ambiguous {
        /// The pin that has two places.
        pin: PointId,
        /// One place, metres.
        first: [f64; 2],
        /// The other.
        second: [f64; 2],
    },
    /// A group of higher class closes for no angle of its trial driver.
    #[error("cannot be assembled: the group of the pin closes in no position")]
    NoClosure {
        /// The pin that cannot be brought to its place.
        pin: PointId,
        /// The least distance by which it is missed, metres.
        least: f64,
    },
    /// A wheel or rack that rolls on without saying where it stands.
    #[error("rolling does not say where the point stands")]
    NotPlaced {
        /// The point.
        point: PointId,
    },
    /// A driven link of one joint whose input states no angle: nothing says how it stands, nor what depends on it.
    #[error("the driven link's input states no angle")]
    NoAngle {
        /// The input, by index.
        input: usize,
    },
    /// A point cannot be drawn from what the scene states of its place.
    #[error("a stated place cannot be drawn")]
    Unplaced {
        /// The point.
        point: PointId,
        /// Why not.
        why: Unplaced,
    },
    /// A construction of the skeleton asks for what nothing in the scene and no step of the drawing gives.
    #[error("the skeleton asks for something that no step draws")]
    Missing(Missing),
    /// The motion takes two bodies apart that roll on each other: no pair holds their centres.
    #[error("rolling bodies come apart")]
    ComesApart {
        /// The rolling pair.
        roll: usize,
        /// How it shows.
        how: Parting,
    },
    /// Two statements of how a link is turned contradict each other by half a turn.
    #[error("a link stands turned round")]
    TurnedRound {
        /// The sliding pair by which it is turned otherwise than it stands.
        slide: usize,
        /// How.
        how: Round,
    },
    /// No construction is known for a group.
    #[error("no construction is known for a group")]
    NoConstruction {
        /// Its links.
        links: Vec<LinkId>,
    },
}

/// Why a point does not stand where the scene states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Unplaced {
    /// The two loci do not meet.
    Apart,
    /// They only touch, or are parallel or one.
    Touches,
    /// A given dimension, guide or radius puts it elsewhere.
    Beside {
        /// By how much, metres.
        by: f64,
    },
}

/// How a link stands turned round.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Round {
    /// What slides without turning has the opposite direction to the one that its guide gives it.
    Ride,
    /// A swivelling guide of one joint leads away from its rider.
    AwayFromRider,
}

/// How two bodies come apart that roll on each other: the derivative of the distance between their centres, or of a
/// centre from a line, that is not zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Parting {
    /// The first, m/s; positive where it grows.
    Speed(f64),
    /// The second, m/s².
    Acceleration(f64),
}

/// Two figures that do not meet, by name and length (metres).
#[derive(Debug, Clone, PartialEq)]
pub struct Misfit {
    /// First base and radius.
    pub first: (String, f64),
    /// Second base and radius, or the guide's link where `second.1` is `None`.
    pub second: (String, Option<f64>),
    /// The pin that both should reach.
    pub pin: String,
    /// Distance of the bases, or of the base from the guide.
    pub distance: f64,
}

impl std::fmt::Display for Misfit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.in_unit(1.0, "m").fmt(f)
    }
}

impl Misfit {
    /// The sum that fails, in a unit of `si` metres.
    #[must_use]
    pub fn in_unit(&self, si: f64, unit: &str) -> String {
        let (p, r1) = &self.first;
        let (q, r2) = &self.second;
        let pin = &self.pin;
        // So many digits that what is told to differ does.
        let digits = |a: f64, b: f64| {
            let differ = |digits: &usize| significant(a / si, *digits) != significant(b / si, *digits);
            (SIGNIFICANT..17).find(differ).unwrap_or(17)
        };
        let of_first = match r2 {
            None => *r1,
            Some(r2) if self.distance > r1 + r2 => r1 + r2,
            Some(r2) => (r1 - r2).abs(),
        };
        let digits = digits(of_first, self.distance);
        let n = |x: f64| significant(x / si, digits);
        match r2 {
            None => format!(
                "{p}{pin} = {} {unit} is shorter than the distance {} {unit} of {p} from the guide of {pin}",
                n(of_first),
                n(self.distance)
            ),
            Some(r2) if self.distance > r1 + r2 => format!(
                "{p}{pin} + {q}{pin} = {} {unit} is less than {p}{q} = {} {unit}",
                n(of_first),
                n(self.distance)
            ),
            Some(_) => format!(
                "|{p}{pin} - {q}{pin}| = {} {unit} is more than {p}{q} = {} {unit}",
                n(of_first),
                n(self.distance)
            ),
        }
    }
}

/// Significant digits of lengths in messages, where these tell them apart.
const SIGNIFICANT: usize = 7;

/// So many significant digits, plainly.
fn significant(x: f64, digits: usize) -> String {
    let text = format!("{x:.*e}", digits - 1);
    text.parse::<f64>().map_or(text, |rounded| format!("{rounded}"))
}

/// The input angles for which a chain closes, radians.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosingRange {
    /// Number of the driven link.
    pub link: u32,
    /// Intervals (from, to) in (−π, π], ascending; empty where it never closes.
    pub intervals: Vec<[f64; 2]>,
}

impl std::fmt::Display for ClosingRange {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        if self.intervals.is_empty() {
            return write!(f, "it closes for no angle of link {}", self.link);
        }
        write!(f, "it closes for angles of link {}", self.link)?;
        for (index, [from, to]) in self.intervals.iter().enumerate() {
            let joint = if index == 0 { "" } else { " and" };
            write!(f, "{joint} from {:.4} to {:.4} deg", from.to_degrees(), to.to_degrees())?;
        }
        Ok(())
    }
}

/// Draws the solution at the given scales, in double precision.
///
/// # Errors
/// See [`DrawError`].
pub fn construct(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
) -> Result<Solution, DrawError> {
    construct_on(Tape::default(), mechanism, structure, plan, scales)
}

/// As [`construct`], on a tape of one's own: a nudged one, to see how a moved stroke moves the answers.
///
/// # Errors
/// See [`DrawError`].
pub fn construct_on(
    tape: Tape,
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
) -> Result<Solution, DrawError> {
    let drawn = draw(Board::new(tape), mechanism, structure, plan, scales)?;
    Ok(finish(drawn, plan, Extent::WholeSkeleton))
}

/// The asked quantities by a board that keeps no record: no bounds, no strokes.
///
/// # Errors
/// See [`DrawError`]; without a record a tangency may read as a miss.
pub fn unrecorded<R: Real>(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
) -> Result<Vec<Option<Numbers<R>>>, DrawError> {
    let board = Board::new(Tape::scratch(R::ARITHMETIC));
    let mut drawn = draw(board, mechanism, structure, plan, scales)?;
    auxiliary::draw_for_forces(&mut drawn, plan);
    Ok(reading::numbers(&mut drawn, |_, _| Some(None)))
}

/// The asked quantities to all digits of an arithmetic, with their bounds: the reference in
/// [`crate::wide::Wide`].
///
/// # Errors
/// See [`DrawError`].
pub fn recorded<R: Real>(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
) -> Result<Vec<Option<Numbers<R>>>, DrawError> {
    let board = Board::new(Tape::of(R::ARITHMETIC));
    let mut drawn = draw(board, mechanism, structure, plan, scales)?;
    auxiliary::draw_for_forces(&mut drawn, plan);
    Ok(reading::numbers(&mut drawn, |tape, mark| {
        if tape.weakness(mark).is_some() { None } else { Some(Some(tape.bound(mark))) }
    }))
}

/// A rough place from which a point stands so far, in sizes of the skeleton, does not hold.
pub(crate) const FAR_FROM_HINT: f64 = 1.0 / 3.0;

/// A place that is rounded in both coordinates lies so much farther off than what it contradicts is missed by, at most.
const ROUNDED: f64 = 4.0;

/// Draws a solution on the board and brings it to the page: `choose` finds the page's scales for the size of the
/// diagrams. The board's own scales are powers of two, so that no digit depends on either. Gives the page's scales too.
/// The plan comes with the extent for which it was made.
///
/// Without a page the solution stays on the board and only numbers are told of it: of what stands on the paper unasked
/// nothing is read off but the places.
///
/// # Errors
/// See [`DrawError`].
pub fn solution(
    arithmetic: Arithmetic,
    mechanism: &Mechanism,
    structure: &Structure,
    (plan, extent): (&Plan, Extent),
    choose: Option<&dyn Fn(Extents) -> Scales>,
) -> Result<(Scales, Solution), DrawError> {
    let board = board_scales(mechanism, structure, plan);
    let on_a_board = |mechanism| {
        let mut drawn = draw(Board::new(Tape::of(arithmetic)), mechanism, structure, plan, board)?;
        let missed = verify::verify(&mut drawn)?;
        verify::contacts(&mut drawn, plan)?;
        Ok((missed, drawn))
    };
    let ranged = |error| with_range(error, mechanism, structure, plan);
    let (missed, mut drawn) = on_a_board(mechanism).map_err(ranged)?;
    let loose;
    if missed > 0.0 {
        // Places that are rounded beside dimensions or guides: as far as they contradict these they may be elsewhere.
        loose = mechanism.loosened(ROUNDED * missed);
        drawn = on_a_board(&loose).map_err(ranged)?.1;
    }
    let Some(choose) = choose else {
        return Ok((board, read_off(drawn, plan, forces::record_numbers, shown::places)));
    };
    let extents = measure(drawn.record(), mechanism, board);
    let mut page = choose(extents.clone());
    drawn.per_page = page.length() / board.length();
    drawn.per_page_of_velocities = page.of(Dimension::Velocity) / board.of(Dimension::Velocity);
    let mut solution = finish(drawn, plan, extent);
    if let Some(quiet) = solution.without_noise(&extents) {
        page = choose(quiet);
    }
    solution.construction.bring_to_page(&mechanism.asked, board, page);
    Ok((page, solution))
}

/// Draws what is planned besides, reads everything off, and says zero of what its bound cannot tell from it.
fn finish(draughtsman: Draughtsman<'_>, plan: &Plan, extent: Extent) -> Solution {
    let mechanism = draughtsman.mechanism;
    let asked: HashSet<Quantity> = mechanism.asked.iter().map(|asked| asked.quantity).collect();
    let is_told = |quantity: &Quantity| extent != Extent::Asked || asked.contains(quantity);
    let mut solution = read_off(draughtsman, plan, forces::record, shown::all);
    let Solution { construction, tape, shown, .. } = &mut solution;
    let mut zeros = settle::zeros(shown, tape, construction, is_told);
    settle::with_rigid(&mut zeros, mechanism, construction);
    settle::settle(construction, &zeros);
    solution
}

/// Draws what is planned besides and reads off what is asked, and of everything else what `record` keeps of forces and `shown`
/// reads.
fn read_off(
    mut draughtsman: Draughtsman<'_>,
    plan: &Plan,
    record: impl Fn(&mut Draughtsman<'_>, &Plan) -> Option<construction::ForceSheet>,
    shown: impl Fn(&mut Draughtsman<'_>) -> Vec<Shown>,
) -> Solution {
    auxiliary::draw(&mut draughtsman, plan);
    draughtsman.note_rooms();
    let (answers, slots) = reading::answers(&mut draughtsman);
    let sheet = record(&mut draughtsman, plan);
    draughtsman.note_forces(sheet);
    let shown = shown(&mut draughtsman);
    let lines = shown::lines(&mut draughtsman);
    let (construction, tape) = draughtsman.finish(answers);
    Solution { construction, tape, slots, shown, lines }
}

/// Draws once at a provisional scale and without a tape, to see how large everything is.
///
/// # Errors
/// See [`DrawError`].
pub fn extents(mechanism: &Mechanism, structure: &Structure, plan: &Plan) -> Result<Extents, DrawError> {
    seen(mechanism, structure, plan).map_err(|error| with_range(error, mechanism, structure, plan))
}

/// As [`extents`], without telling for which input a chain closes that does not close.
pub(crate) fn seen(mechanism: &Mechanism, structure: &Structure, plan: &Plan) -> Result<Extents, DrawError> {
    let scales = planned_scales(mechanism, structure, plan);
    // What was searched for without a tape is where it was with one.
    let searched = Searched::default();
    let drawn_on = |board: Board| -> Result<Extents, DrawError> {
        let mut drawn = draw_departing(board, mechanism, structure, plan, scales, (&[], Some(&searched)))?;
        verify::verify(&mut drawn)?;
        Ok(measure(drawn.record(), mechanism, scales))
    };
    // A tangency can only be told from a miss with a tape; it is rare, so try without one first.
    drawn_on(Board::scratch()).or_else(|_| drawn_on(Board::default()))
}

/// The places of all points that a plan finds, metres in the world, drawn on a board without a tape.
///
/// # Errors
/// See [`DrawError`].
pub(crate) fn places(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
) -> Result<Vec<Option<[f64; 2]>>, DrawError> {
    let scales = planned_scales(mechanism, structure, plan);
    let origin = origin(mechanism);
    let world = |at: [f64; 2]| [0, 1].map(|axis| origin[axis] + at[axis] * scales.length());
    let drawn = draw(Board::scratch(), mechanism, structure, plan, scales)?;
    Ok(drawn.record().space.places.iter().map(|at| at.map(world)).collect())
}

/// How the links stand whose own axes a plan lays, by link, their origins in metres from the skeleton's; drawn on a board
/// without a tape.
///
/// # Errors
/// See [`DrawError`].
pub(crate) fn axes(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
) -> Result<Vec<Option<construction::Axes>>, DrawError> {
    let scales = planned_scales(mechanism, structure, plan);
    let drawn = draw(Board::scratch(), mechanism, structure, plan, scales)?;
    let metres = |axes: construction::Axes| construction::Axes {
        origin: axes.origin.map(|x| x * scales.length()),
        ..axes
    };
    Ok(drawn.axes().into_iter().map(|axes| axes.map(metres)).collect())
}

/// World coordinates of the skeleton's origin, m.
pub(crate) fn origin(mechanism: &Mechanism) -> [f64; 2] {
    position::origin_of_space(mechanism).map(|given| given.value)
}

fn draw<'m>(
    board: Board,
    mechanism: &'m Mechanism,
    structure: &'m Structure,
    plan: &Plan,
    scales: Scales,
) -> Result<Draughtsman<'m>, DrawError> {
    draw_departing(board, mechanism, structure, plan, scales, (&[], None))
}

/// As [`draw`], with departures from the right construction, and with what was found by trial in drawings before.
fn draw_departing<'m>(
    board: Board,
    mechanism: &'m Mechanism,
    structure: &'m Structure,
    plan: &Plan,
    scales: Scales,
    (departures, searched): (&'m [Departure], Option<&'m Searched>),
) -> Result<Draughtsman<'m>, DrawError> {
    let begun = |board: Board| {
        let mut draughtsman = Draughtsman::new(board, mechanism, structure, scales);
        (draughtsman.departures, draughtsman.searched) = (departures, searched);
        draughtsman
    };
    let mut draughtsman = begun(board);
    let again = !mechanism.forces.friction.is_empty() || !mechanism.named_sought().is_empty();
    if draughtsman.board.tape().trembles() && again {
        // As often as the perfect hand draws the forces again, and with trials as large as what it finds.
        let perfect = drawn_by(begun(Board::scratch()), plan);
        let perfect = perfect.or_else(|_| drawn_by(begun(Board::default()), plan))?;
        draughtsman.redrawn = forces::redrawn(&perfect);
        draughtsman.tried_sizes = forces::found_by_trial(&perfect);
    }
    drawn_by(draughtsman, plan)
}

/// Draws what the plan says.
fn drawn_by<'m>(mut draughtsman: Draughtsman<'m>, plan: &Plan) -> Result<Draughtsman<'m>, DrawError> {
    position::draw(&mut draughtsman, plan)?;
    if plan.centres.feeds {
        centres::draw(&mut draughtsman, plan);
        draughtsman.fed = centres::feed(&mut draughtsman, plan);
    } else if !plan.steps(Order::Velocity).is_empty() {
        velocity::draw(&mut draughtsman, plan);
    }
    if !plan.steps(Order::Acceleration).is_empty() && draughtsman.fed.is_ok() {
        acceleration::draw(&mut draughtsman, plan);
    }
    if !plan.centres.wanted.is_empty() && !plan.centres.feeds {
        centres::draw(&mut draughtsman, plan);
    }
    if !plan.forces.shares.is_empty() {
        forces::draw(&mut draughtsman, plan);
    }
    Ok(draughtsman)
}

/// Adds to a chain that does not close the range of the input in which it does, found by turning the
/// one driven link through a whole turn on a blank board and halving the edges.
fn with_range(error: DrawError, mechanism: &Mechanism, structure: &Structure, plan: &Plan) -> DrawError {
    const TRIALS: i32 = 720;
    const HALVINGS: usize = 48;
    let DrawError::CannotAssemble { pin, why, range: None } = &error else { return error };
    let driven: Vec<usize> = structure
        .groups
        .iter()
        .filter_map(|g| match g.kind {
            GroupKind::Driver { input: Drive::Input(input), .. }
            | GroupKind::DrivenBar { input: Drive::Input(input), .. } => Some(input),
            _ => None,
        })
        .collect();
    let (&[input], 1) = (driven.as_slice(), mechanism.inputs.len()) else { return error };
    let Input::Angle { link, angle: Some(_), .. } = mechanism.inputs[input] else { return error };
    let positions = plan.skeleton();
    let scales = planned_scales(mechanism, structure, &positions);
    let closes = |at: f64| {
        let mut turned = mechanism.clone();
        if let Input::Angle { angle, .. } = &mut turned.inputs[input] {
            *angle = Some(Given::exact(at));
        }
        let board = Board::scratch();
        !matches!(draw(board, &turned, structure, &positions, scales), Err(DrawError::CannotAssemble { .. }))
    };
    let angle_of = |trial: i32| std::f64::consts::PI * (2.0 * f64::from(trial) / f64::from(TRIALS) - 1.0);
    let edge = |mut outside: f64, mut inside: f64| {
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(outside, inside);
            if closes(middle) { inside = middle } else { outside = middle }
        }
        inside
    };
    let mut intervals: Vec<[f64; 2]> = Vec::new();
    let mut open: Option<f64> = closes(angle_of(0)).then(|| angle_of(0));
    for trial in 1..=TRIALS {
        let (before, now) = (angle_of(trial - 1), angle_of(trial));
        match (open, closes(now)) {
            (None, true) => open = Some(edge(before, now)),
            (Some(from), false) => {
                intervals.push([from, edge(now, before)]);
                open = None;
            }
            _ => {}
        }
    }
    if let Some(from) = open {
        intervals.push([from, std::f64::consts::PI]);
    }
    // One interval across ±180° reads as one.
    if let (Some(&[first, end]), Some(&[start, last])) = (intervals.first(), intervals.last())
        && intervals.len() > 1
        && first == -std::f64::consts::PI
        && last == std::f64::consts::PI
    {
        intervals.pop();
        intervals[0] = [start, end + 2.0 * std::f64::consts::PI];
        intervals.rotate_left(1);
    }
    let range = ClosingRange { link: mechanism.link(link).number, intervals };
    DrawError::CannotAssemble { pin: *pin, why: why.clone(), range: Some(range) }
}

/// A scale factor as the board wants it.
fn scale(si_per_mm: f64) -> Scale {
    Scale { si_per_mm }
}
