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
mod departure;
mod draughtsman;
mod dyad;
mod figure;
mod link_figure;
mod loci;
mod missing;
mod page;
mod pinned_rack;
mod pose;
mod position;
mod reading;
mod rolled;
mod settle;
mod shown;
mod transcribe;
mod trial;
mod velocity;
mod verify;

pub use by_hand::{Draughtsmen, HandError, Spread, by_hand, by_one_hand};
pub use departure::{Departure, Sketch, Twist, sketch};
pub(crate) use figure::standing;
pub use missing::Missing;
pub use reading::Numbers;
pub use shown::{Shown, is_trial};
pub use transcribe::{Transcribed, TranscribedWithBounds, Without, transcribe, transcribe_with_bounds};

use crate::board::{Arithmetic, Board, Real, Scale, Tape};
use crate::given::Given;
use crate::mechanism::statement::Locus;
use crate::mechanism::structure::{Drive, GroupKind, Structure};
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Roll};
use crate::plan::Plan;
use construction::{Construction, Label, OtherPosition, Polygon, TransferInk};
use draughtsman::Draughtsman;

/// The scale factors of a solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales {
    /// Metres per millimetre of paper.
    pub length: f64,
    /// m/s per millimetre of paper.
    pub velocity: f64,
    /// m/s² per millimetre of paper.
    pub acceleration: f64,
}

/// How large the diagrams are in reality, to choose scales by.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Extents {
    /// Width and height of the skeleton, m.
    pub space: [f64; 2],
    /// Width and height of the skeleton with its pitch circles, m.
    pub rims: [f64; 2],
    /// Where the skeleton's lower left corner lies, from its origin, m.
    pub least: [f64; 2],
    /// Width and height of the skeleton with the other positions that it shows, m.
    pub positions: [f64; 2],
    /// Width and height of the velocity polygon, m/s; where there is none, of the arrows on the skeleton.
    pub velocity: [f64; 2],
    /// Width and height of the acceleration polygon, m/s²; zero where there is none.
    pub acceleration: [f64; 2],
    /// The joints of the skeleton, m, from its origin.
    pub joints: Vec<[f64; 2]>,
    /// The points of the velocity and of the acceleration polygon with their poles, m/s and m/s², without those of trials.
    pub images: [Vec<[f64; 2]>; 2],
    /// How many vectors the velocity and the acceleration polygon have.
    pub vectors: [usize; 2],
    /// How much there is to be told of the steps.
    pub told: Told,
    /// Whether there is a circle diagram.
    pub circle: bool,
}

/// How much there is to be told of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Told {
    /// Steps.
    pub steps: usize,
    /// Vector equations.
    pub equations: usize,
    /// What is done, read and calculated.
    pub acts: usize,
}

impl Extents {
    /// The same where the skeleton shows these positions as well.
    #[must_use]
    pub fn with(mut self, others: &[OtherPosition]) -> Self {
        let all = || others.iter().flat_map(|other| other.places.iter().flatten());
        for axis in 0..2 {
            let least = all().map(|at| at[axis]).fold(self.least[axis], f64::min);
            let most = all().map(|at| at[axis]).fold(self.least[axis] + self.space[axis], f64::max);
            self.positions[axis] = most - least;
        }
        self
    }
}

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
}

impl Solution {
    /// The extents without those of a polygon in which nothing is clear of zero: its scale would be that of roundings.
    /// `None` where there is no such polygon.
    #[must_use]
    pub fn without_noise(&self, extents: &Extents) -> Option<Extents> {
        let noise = |polygon: &Option<Polygon>, extent: [f64; 2]| {
            let vectors = || polygon.iter().flat_map(|p| &p.vectors).filter(|v| !is_trial(v));
            extent != [0.0; 2] && vectors().next().is_some() && vectors().all(|v| v.is_zero)
        };
        let mut quiet = extents.clone();
        if noise(&self.construction.velocity, extents.velocity) {
            quiet.velocity = [0.0; 2];
        }
        if noise(&self.construction.acceleration, extents.acceleration) {
            quiet.acceleration = [0.0; 2];
        }
        (quiet != *extents).then_some(quiet)
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
        let n = |x: f64| significant(x / si);
        match r2 {
            None => format!(
                "{p}{pin} = {} {unit} is shorter than the distance {} {unit} of {p} from the guide of {pin}",
                n(*r1),
                n(self.distance)
            ),
            Some(r2) if self.distance > r1 + r2 => format!(
                "{p}{pin} + {q}{pin} = {} {unit} is less than {p}{q} = {} {unit}",
                n(r1 + r2),
                n(self.distance)
            ),
            Some(r2) => format!(
                "|{p}{pin} - {q}{pin}| = {} {unit} is more than {p}{q} = {} {unit}",
                n((r1 - r2).abs()),
                n(self.distance)
            ),
        }
    }
}

/// Seven significant digits, plainly.
fn significant(x: f64) -> String {
    let text = format!("{x:.6e}");
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
    Ok(finish(draw(Board::new(tape), mechanism, structure, plan, scales)?, plan))
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
    Ok(reading::numbers(&mut drawn, |tape, mark| {
        if tape.weakness(mark).is_some() { None } else { Some(Some(tape.bound(mark))) }
    }))
}

/// Draws a solution on the board and brings it to the page: `choose` finds the page's scales for the size of the
/// diagrams. The board's own scales are powers of two, so that no digit depends on either. Gives the page's scales too.
///
/// # Errors
/// See [`DrawError`].
pub fn solution(
    arithmetic: Arithmetic,
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    choose: impl Fn(Extents) -> Scales,
) -> Result<(Scales, Solution), DrawError> {
    let board = board_scales(mechanism);
    let drawn = draw(Board::new(Tape::of(arithmetic)), mechanism, structure, plan, board);
    let drawn = drawn.and_then(|mut drawn| verify::verify(&mut drawn).map(|()| drawn));
    let mut drawn = drawn.map_err(|error| with_range(error, mechanism, structure, plan))?;
    let extents = measure(drawn.record(), mechanism, board);
    let mut page = choose(extents.clone());
    drawn.per_page = page.length / board.length;
    let mut solution = finish(drawn, plan);
    if let Some(quiet) = solution.without_noise(&extents) {
        page = choose(quiet);
    }
    solution.construction.bring_to_page(&mechanism.asked, board, page);
    Ok((page, solution))
}

/// Draws what is planned besides, reads everything off, and says zero of what its bound cannot tell from it.
fn finish(mut draughtsman: Draughtsman<'_>, plan: &Plan) -> Solution {
    auxiliary::draw(&mut draughtsman, plan);
    let (answers, slots) = reading::answers(&mut draughtsman);
    let shown = shown::all(&mut draughtsman);
    let (mut construction, mut tape) = draughtsman.finish(answers);
    settle::settle(&mut construction, &settle::zeros(&shown, &mut tape));
    Solution { construction, tape, slots, shown }
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
    let scales = provisional_scales(mechanism);
    // A tangency can only be told from a miss with a tape; it is rare, so try without one first.
    let bare = || -> Result<Extents, DrawError> {
        let mut drawn = draw(Board::scratch(), mechanism, structure, plan, scales)?;
        verify::verify(&mut drawn)?;
        Ok(measure(drawn.record(), mechanism, scales))
    };
    let taped = || -> Result<Extents, DrawError> {
        let mut drawn = draw(Board::default(), mechanism, structure, plan, scales)?;
        verify::verify(&mut drawn)?;
        Ok(measure(drawn.record(), mechanism, scales))
    };
    bare().or_else(|_| taped())
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
    let scales = provisional_scales(mechanism);
    let origin = origin(mechanism);
    let world = |at: [f64; 2]| [0, 1].map(|axis| origin[axis] + at[axis] * scales.length);
    let drawn = draw(Board::scratch(), mechanism, structure, plan, scales)?;
    Ok(drawn.record().space.places.iter().map(|at| at.map(world)).collect())
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
    draw_departing(board, mechanism, structure, plan, scales, &[])
}

/// As [`draw`], with departures from the right construction.
fn draw_departing<'m>(
    board: Board,
    mechanism: &'m Mechanism,
    structure: &'m Structure,
    plan: &Plan,
    scales: Scales,
    departures: &'m [Departure],
) -> Result<Draughtsman<'m>, DrawError> {
    let mut draughtsman = Draughtsman::new(board, mechanism, structure, scales);
    draughtsman.departures = departures;
    drawn_by(draughtsman, plan)
}

/// Draws what the plan says.
fn drawn_by<'m>(mut draughtsman: Draughtsman<'m>, plan: &Plan) -> Result<Draughtsman<'m>, DrawError> {
    position::draw(&mut draughtsman, plan)?;
    if plan.centres.feeds {
        centres::draw(&mut draughtsman, plan);
        draughtsman.fed = centres::feed(&mut draughtsman, plan);
    } else if !plan.velocity.is_empty() {
        velocity::draw(&mut draughtsman, plan);
    }
    if !plan.acceleration.is_empty() && draughtsman.fed.is_ok() {
        acceleration::draw(&mut draughtsman, plan);
    }
    if !plan.centres.wanted.is_empty() && !plan.centres.feeds {
        centres::draw(&mut draughtsman, plan);
    }
    Ok(draughtsman)
}

/// Scales at which paper numbers are of order 100, whatever the units.
fn provisional_scales(mechanism: &Mechanism) -> Scales {
    let mut size: f64 = 0.0;
    let mut longest: f64 = 0.0;
    let mut seen = |x: f64| longest = longest.max(x.abs());
    for link in &mechanism.links {
        link_figure::given_lengths(link).into_iter().for_each(&mut seen);
    }
    let places: Vec<[f64; 2]> = mechanism.points.iter().filter_map(|p| p.place.hint()).collect();
    for locus in mechanism.statements.iter().flat_map(|statement| statement.loci) {
        if let Locus::Circle { radius, .. } = locus {
            seen(radius.value);
        }
    }
    for p in &places {
        size = size.max(libm::hypot(p[0] - places[0][0], p[1] - places[0][1]));
    }
    size = size.max(longest);
    let (mut speed, mut acceleration) = (0.0_f64, 0.0_f64);
    for input in &mechanism.inputs {
        let (v, a) = match input {
            Input::Angle { omega, alpha, .. } => {
                (omega.value * size, omega.value * omega.value * size + alpha.value.abs() * size)
            }
            Input::Speed { speed, alpha, .. } => {
                (speed.value, speed.value * speed.value / size + alpha.value.abs() * size)
            }
            Input::Slide { velocity, acceleration, .. } => {
                (velocity.value, acceleration.value.abs() + velocity.value * velocity.value / size)
            }
        };
        speed = speed.max(v.abs());
        acceleration = acceleration.max(a.abs());
    }
    let per_mm = |largest: f64| {
        let scale = largest / 100.0;
        if scale.is_normal() { scale } else { 1.0 }
    };
    Scales { length: per_mm(size), velocity: per_mm(speed), acceleration: per_mm(acceleration) }
}

/// The scales of the board: powers of two at which paper numbers are of order 100. Every operation is homogeneous, so
/// that no bit of an answer depends on them.
fn board_scales(mechanism: &Mechanism) -> Scales {
    let Scales { length, velocity, acceleration } = provisional_scales(mechanism);
    let [length, velocity, acceleration] = [length, velocity, acceleration].map(|scale| {
        let (mantissa, exponent) = libm::frexp(scale);
        libm::ldexp(1.0, if mantissa < std::f64::consts::FRAC_1_SQRT_2 { exponent - 1 } else { exponent })
    });
    Scales { length, velocity, acceleration }
}

fn measure(record: &Construction, mechanism: &Mechanism, scales: Scales) -> Extents {
    let extent = |points: &mut dyn Iterator<Item = [f64; 2]>, start: Option<[f64; 2]>, scale: f64| {
        let mut bounds: Option<[[f64; 2]; 2]> = start.map(|p| [p, p]);
        for p in points {
            let [low, high] = bounds.get_or_insert([p, p]);
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        bounds.map_or([0.0; 2], |[low, high]| [(high[0] - low[0]) * scale, (high[1] - low[1]) * scale])
    };
    let polygon = |polygon: &Option<Polygon>, scale: f64| {
        polygon.as_ref().map_or([0.0; 2], |p| {
            // What was tried lies anywhere, and where construction lines end has no name.
            let tried = |label: Label| matches!(label, Label::Trial { .. });
            let points = p.images.iter().filter(|i| !tried(i.label)).map(|i| i.at);
            let vectors = p.vectors.iter().filter(|v| !tried(v.tail) && !tried(v.head));
            extent(&mut points.chain(vectors.flat_map(|v| [v.from, v.to])), Some([0.0; 2]), scale)
        })
    };
    let images = |polygon: &Option<Polygon>, scale: f64| {
        let images = polygon.iter().flat_map(|p| &p.images);
        let named = images.filter(|image| !matches!(image.label, Label::Trial { .. }));
        let places = named.map(|image| image.at.map(|x| x * scale));
        if polygon.is_some() { places.chain([[0.0; 2]]).collect() } else { Vec::new() }
    };
    let polygons = [&record.velocity, &record.acceleration];
    // Arrows on the skeleton, where there is no polygon: half as long as a polygon would be.
    let arrows =
        record.circle.iter().flat_map(|c| &c.transfers).flat_map(|t| &t.ink).filter_map(|ink| match ink {
            TransferInk::Velocity { at, tip, .. } | TransferInk::Turned { at, tip, .. } => {
                Some(2.0 * libm::hypot(tip[0] - at[0], tip[1] - at[1]) * scales.velocity)
            }
            _ => None,
        });
    let longest = arrows.fold(0.0, f64::max);
    let places = || record.space.places.iter().flatten().copied();
    let space = extent(&mut places(), None, scales.length);
    let wheels = mechanism.rolls.iter().flat_map(|roll| pitch_circle_corners(roll, record, scales));
    let rims = extent(&mut places().chain(wheels), None, scales.length);
    let least = [0, 1].map(|axis| places().map(|at| at[axis] * scales.length).fold(f64::INFINITY, f64::min));
    let least = least.map(|x| if x.is_finite() { x } else { 0.0 });
    Extents {
        space,
        rims,
        least,
        positions: space,
        velocity: match &record.velocity {
            None => [longest; 2],
            drawn => polygon(drawn, scales.velocity),
        },
        acceleration: polygon(&record.acceleration, scales.acceleration),
        joints: places().map(|at| at.map(|x| x * scales.length)).collect(),
        images: [
            images(&record.velocity, scales.velocity),
            images(&record.acceleration, scales.acceleration),
        ],
        vectors: polygons.map(|polygon| polygon.as_ref().map_or(0, |p| p.vectors.len())),
        told: Told {
            steps: record.steps.len(),
            equations: record.steps.iter().map(|step| step.equations.len()).sum(),
            acts: record.steps.iter().map(|step| step.acts.len()).sum(),
        },
        circle: record.circle.is_some(),
    }
}

/// Opposite corners of the squares about the pitch circles of a roll, on paper.
fn pitch_circle_corners(roll: &Roll, record: &Construction, scales: Scales) -> Vec<[f64; 2]> {
    let circles = match roll {
        Roll::Circles { centres, radii, .. } => [0, 1].map(|i| (centres[i], radii[i].value)).to_vec(),
        Roll::Line { centre, radius, .. } => vec![(*centre, radius.value)],
    };
    let corners = circles.into_iter().filter_map(|(centre, radius)| {
        let [x, y] = (*record.space.places.get(centre.0)?)?;
        let r = radius / scales.length;
        Some([[x - r, y - r], [x + r, y + r]])
    });
    corners.flatten().collect()
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
            GroupKind::Driver { input: Drive::Input(input), .. } => Some(input),
            _ => None,
        })
        .collect();
    let (&[input], 1) = (driven.as_slice(), mechanism.inputs.len()) else { return error };
    let Input::Angle { link, angle: Some(_), .. } = mechanism.inputs[input] else { return error };
    let positions = Plan { position: plan.position.clone(), ..Plan::default() };
    let scales = provisional_scales(mechanism);
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
