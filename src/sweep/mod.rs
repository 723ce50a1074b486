//! A mechanism over the range of its input: positions, velocities and accelerations at many places, from
//! one drawing that is transcribed once.
//!
//! The assembly of the scene is kept from place to place. At a *limit* two arcs just touch and the input
//! goes no further; at a *change point* they touch and come apart on the other side: the mechanism goes
//! through, and the other meeting point is taken from there on. Limits, change points, dead positions and
//! extremes are found as roots of what the program computes, by halving an interval down to neighbouring
//! doubles, not by sampling; sampling only has to see that there is one.
//!
//! Over the input its rates are those of the scene at every place. Over time ([`Over::Time`]) every input moves
//! from the scene's instant on, with constant acceleration, and its rate with it.
//!
//! [`Sweep::with_bounds`] gives a bound for every number of every position.
//!
//! **Architecture Invariant:** nothing here knows paper, a file or the analytic solver.

mod bounds;
mod carried;
mod course;
mod curve;
mod friction;
pub mod governor;
mod positions;
mod prepare;
mod reversals;

use crate::board::{Dual, LANES, Lane, Listing, Variable, Workspace};
pub use crate::graphical::Without;
use crate::graphical::{DrawError, Transcribed, transcribe};
use crate::mechanism::quantity::{Asked, Kind, Nature, Order, Quantity, Stuck};
use crate::mechanism::structure::{Structure, StructureError};
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::{CentreSource, Extent, Plan};

pub use bounds::SweepWithBounds;
pub use carried::Skeleton;
pub use course::{Event, EventKind, Stretch};
pub use curve::{Table, Track};
pub use positions::{PositionError, moved_to, other_positions};
pub use reversals::Reversal;

/// What a sweep goes over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Over {
    /// The place of the first input.
    #[default]
    Input,
    /// Time from the scene's instant, in which every input moves.
    Time,
}

/// What is varied in a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InputKind {
    /// Time, seconds from the scene's instant.
    Time,
    /// The angle of a link, radians.
    Angle(LinkId),
    /// The place of a slide (by index) along its guide, metres.
    Slide(usize),
}

impl InputKind {
    /// What it is, as it stands above a column.
    #[must_use]
    pub fn told(self, mechanism: &Mechanism) -> String {
        match self {
            Self::Angle(link) => format!("angle of link {}", mechanism.link(link).number),
            Self::Slide(slide) => match mechanism.pin_of_slide(slide) {
                Some(pin) => format!("place of {} along its guide", mechanism.point(pin).name),
                None => format!("place of slide {}", slide + 1),
            },
            Self::Time => "time".to_owned(),
        }
    }
}

/// Why a scene cannot be swept.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// The freedoms do not match the inputs.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The scene's own position cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Something in the scene holds for this instant only.
    #[error("{0}")]
    Instant(String),
    /// The range is empty, or the scene's own place is not in it.
    #[error("{0}")]
    Range(String),
}

/// One number over the sweep: a scalar, or a coordinate of a vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// The quantity.
    pub asked: Asked,
    /// 0 or 1 for the coordinates of a vector; `None` for a scalar.
    pub axis: Option<usize>,
    /// A motion that may have a stroke: of a pin on a guide of the frame, or of a link pivoted to it.
    pub motion: bool,
    /// A quantity that the sweep watches for its extremes, though nobody asked.
    pub watched: bool,
}

impl Column {
    /// Its heading: the quantity's name, and the axis of a vector.
    #[must_use]
    pub fn name(&self) -> String {
        match self.axis {
            None => self.asked.name.clone(),
            Some(0) => format!("{}.x", self.asked.name),
            Some(_) => format!("{}.y", self.asked.name),
        }
    }

    /// Whether it stands wherever the mechanism does: what moves is not behind it.
    #[must_use]
    pub fn is_of_position(&self) -> bool {
        let kind = self.asked.quantity.kind();
        matches!(kind, Kind::Motion(row) if row.order == Order::Position)
    }

    /// A quantity without a sense: the program goes on with the sign that it had in the drawing.
    #[must_use]
    pub fn is_unsigned(&self) -> bool {
        self.asked.quantity.nature() == Nature::Size
    }

    /// Whether it hangs on how what acts is balanced.
    #[must_use]
    pub fn is_of_balance(&self) -> bool {
        matches!(self.asked.quantity, Quantity::Force(..))
    }

    /// The number as it counts for the quantity.
    fn counted(&self, m: Dual) -> Dual {
        if self.is_unsigned() && m.value < 0.0 {
            return Dual { value: -m.value, slope: -m.slope, error: m.error };
        }
        m
    }
}

/// An instant centre: its two columns are one thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Centre {
    /// Which.
    pub asked: Asked,
    /// Indices of the columns of its coordinates; neither has a value where it lies at infinity.
    pub columns: [usize; 2],
}

/// What has extremes.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Measure {
    /// A scalar, or a coordinate of a place.
    Column(usize),
    /// The magnitude of a vector, by its columns.
    Magnitude([usize; 2]),
}

impl Measure {
    /// Its column, or the first of them.
    fn first(self) -> usize {
        match self {
            Self::Column(column) | Self::Magnitude([column, _]) => column,
        }
    }

    /// All that can be extreme: of centres, which come from infinity and go there, nothing.
    fn all(columns: &[Column]) -> Vec<Self> {
        let measure = |(index, column): (usize, &Column)| match (column.axis, column.asked.quantity) {
            (_, Quantity::Centre(..)) => None,
            (None, _) | (Some(_), Quantity::Position(_)) => Some(Self::Column(index)),
            (Some(0), _) => Some(Self::Magnitude([index, index + 1])),
            (Some(_), _) => None,
        };
        columns.iter().enumerate().filter_map(measure).collect()
    }
}

/// The mechanism at one place of its input.
#[derive(Debug, Clone, PartialEq)]
pub struct Position {
    /// The input or the time, SI units.
    pub at: f64,
    /// One number for each column, SI units; `None` where it is indeterminate here.
    pub values: Vec<Option<f64>>,
}

/// A motion to and fro in a whole turn of the input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SliderStroke {
    /// Index of the column: a coordinate of a pin on a guide, or the angle of a rocker.
    pub column: usize,
    /// From the least to the greatest value, SI units; along the guide for a pin.
    pub length: f64,
    /// The input at the least and at the greatest value, SI units.
    pub ends: [f64; 2],
    /// Time of the slower way over that of the quicker one, at constant speed of the input.
    pub time_ratio: f64,
}

/// A mechanism made ready to be swept.
#[derive(Debug, Clone)]
pub struct Sweep {
    /// What is varied.
    pub input: InputKind,
    /// From where to where, SI units.
    pub range: [f64; 2],
    /// Where the scene's own position is in it.
    pub start: f64,
    /// The range is one whole turn, after which everything comes again.
    pub whole_turn: bool,
    /// The columns, those asked for first.
    pub columns: Vec<Column>,
    /// The instant centres among them that have a place.
    pub centres: Vec<Centre>,
    /// What was asked for and has no column, with the reason: centres that are always at infinity, and what nothing
    /// determines.
    pub without: Vec<(Asked, Without)>,
    /// Where the mechanism moves freely, ascending.
    pub stretches: Vec<Stretch>,
    /// What happens on the way, ascending.
    pub events: Vec<Event>,
    /// From where to where, next to a limit or a dead position, more than one balance with friction fits; no force is told
    /// there. SI units, ascending.
    pub ambiguous: Vec<[f64; 2]>,
    /// Where something that rubs, or a load against a motion, turns round: forces leap there. Ascending; none over time.
    pub reversals: Vec<Reversal>,
    /// The rate of what is varied: the first input's, SI units per second; over time 1.
    pub rate: f64,
    /// At how many places of the range to look.
    looks: u32,
    measures: Vec<Measure>,
    looked: u64,
    transcribed: Transcribed,
    /// The mechanism as the scene has it.
    placed: Mechanism,
    /// The mechanism as it can move, what varies in it, and whence its centres come.
    ready: (Mechanism, Variable, CentreSource),
    /// How many of its asked quantities somebody asked for.
    asked: usize,
    /// The wheels whose points are carried along by how far they have rolled, each with its centre.
    rolling: Vec<(LinkId, PointId)>,
}

/// How many places of a turn, or of a slide's range, are looked at to see that something happens between two of
/// them.
const LOOKS: u32 = 720;

/// No sweep goes over more turns.
const MOST_TURNS: f64 = 100.0;

/// How often sampling to a tolerance halves an interval: towards a limit places go as a root, and it takes many.
const MOST_HALVINGS: u32 = 24;

/// Sampling to a tolerance puts no more places into a sixteenth of a stretch.
pub const MOST_PLACES: usize = 20_000;

impl Sweep {
    /// Whether the input moves toward smaller values, as the angle of a link that turns clockwise.
    #[must_use]
    pub fn is_backwards(&self) -> bool {
        self.rate < 0.0 && self.input != InputKind::Time
    }

    /// The ends of the range in the order in which the motion passes them.
    #[must_use]
    pub fn passed(&self) -> [f64; 2] {
        let [from, to] = self.range;
        if self.is_backwards() { [to, from] } else { [from, to] }
    }

    /// Transcribes the drawing of a mechanism and walks the range of its first input: `range` in SI units,
    /// else a whole turn, or for a slide as far as it goes.
    ///
    /// # Errors
    /// See [`SweepError`].
    pub fn new(mechanism: &Mechanism, range: Option<[f64; 2]>) -> Result<Self, SweepError> {
        Self::over(Over::Input, mechanism, range)
    }

    /// As [`Sweep::new`], over the input or over time; over time `range` is in seconds, else what the first input
    /// takes for a whole turn, or a slide for as far as it may go.
    ///
    /// # Errors
    /// See [`SweepError`].
    pub fn over(over: Over, mechanism: &Mechanism, range: Option<[f64; 2]>) -> Result<Self, SweepError> {
        Self::showing(over, mechanism, range, &[])
    }

    /// As [`Sweep::over`], with columns of what is shown besides: as those of the quantities that it watches, but nothing
    /// is said of their extremes.
    ///
    /// # Errors
    /// See [`SweepError`].
    pub fn showing(
        over: Over,
        mechanism: &Mechanism,
        range: Option<[f64; 2]>,
        shown: &[Asked],
    ) -> Result<Self, SweepError> {
        let stated = range;
        let asked = mechanism.asked.len();
        let standing = crate::graphical::standing(mechanism)?;
        let placed = &*standing;
        let moved = prepare::Moved::by_asked(placed, shown)?;
        prepare::stands(placed, shown)?;
        let (mut mechanism, swept, start) = prepare::ready(placed, &moved)?;
        let told = mechanism.asked.len();
        for more in shown {
            if !mechanism.asked.iter().any(|known| known.quantity == more.quantity) {
                mechanism.asked.push(more.clone());
            }
        }
        let structure = Structure::of(&mechanism)?;
        let wheels = prepare::wheels_rolling_on(placed, &mechanism, &structure, &moved)?;
        let variable = match over {
            Over::Input => Variable::Input(swept),
            Over::Time => Variable::Time(prepare::laws(&mut mechanism)?),
        };
        let transcribe_from = |source: CentreSource| {
            let mut plan = Plan::with(&mechanism, &structure, Extent::Asked, source);
            if told < mechanism.asked.len() {
                // What is told is the same number whatever is shown besides.
                let asked = mechanism.asked[..told].to_vec();
                let alone = Mechanism { asked, ..mechanism.clone() };
                let alone = Plan::with(&alone, &structure, Extent::Asked, source);
                plan.centres.first = Some(Box::new(alone.centres));
                plan.at_contacts = alone.at_contacts;
            }
            transcribe(&mechanism, &structure, &plan, (variable.clone(), asked), &wheels.starts)
        };
        let mut source = CentreSource::Diagram;
        let left_to_rolling = |error| prepare::left_to_rolling(placed, error);
        let mut transcribed = transcribe_from(source).map_err(left_to_rolling)?;
        if transcribed.stalled {
            source = CentreSource::Velocities;
            transcribed = transcribe_from(source).map_err(left_to_rolling)?;
        }
        let mut columns = Vec::new();
        for (index, (asked_here, numbers)) in mechanism.asked.iter().zip(&transcribed.numbers).enumerate() {
            for axis in 0..*numbers {
                let axis = (*numbers == 2).then_some(axis);
                let motion = match asked_here.quantity {
                    Quantity::Position(p) => prepare::is_guided(&mechanism, p),
                    Quantity::Angle(_) => true,
                    _ => false,
                };
                columns.push(Column { asked: asked_here.clone(), axis, motion, watched: index >= asked });
            }
        }
        let first_of = |index: usize| transcribed.numbers.iter().take(index).sum::<usize>();
        let told = first_of(told);
        let centres = transcribed
            .centres
            .iter()
            .map(|&index| Centre {
                asked: mechanism.asked[index].clone(),
                columns: [first_of(index), first_of(index) + 1],
            })
            .collect();
        let without = transcribed
            .without
            .iter()
            .filter(|(index, _)| *index < asked)
            .map(|(index, why)| (mechanism.asked[*index].clone(), *why))
            .collect();
        let (input, rate) = match mechanism.inputs[swept] {
            Input::Angle { link, omega, .. } => (InputKind::Angle(link), omega.value),
            Input::Speed { link, .. } => (InputKind::Angle(link), 0.0),
            Input::Slide { slide, velocity, .. } => (InputKind::Slide(slide), velocity.value),
        };
        // An angle goes round; a slide, and what moves in time, come to an end.
        let range_is_free = range.is_none() && (over == Over::Time || matches!(input, InputKind::Slide(_)));
        let (input, rate, range, start, whole_turn) = match &variable {
            Variable::Input(_) => {
                let (range, start, whole_turn) = prepare::range(input, range, start, &mechanism, &moved)?;
                (input, rate, range, start, whole_turn)
            }
            Variable::Time(laws) => {
                let (range, whole_turn) = prepare::span(input, range, laws, &mechanism, &moved)?;
                (InputKind::Time, 1.0, range, 0.0, whole_turn)
            }
        };
        // A wheel that has rolled on does not stand as before when the input comes round.
        let whole_turn = whole_turn && wheels.rolling.is_empty();
        let mut sweep = Self {
            rolling: wheels.rolling,
            input,
            range,
            start,
            whole_turn,
            measures: Measure::all(&columns[..told]),
            columns,
            centres,
            without,
            looked: 0,
            stretches: Vec::new(),
            events: Vec::new(),
            ambiguous: Vec::new(),
            reversals: Vec::new(),
            rate,
            looks: looks(&variable, &mechanism, range)?,
            transcribed,
            placed: placed.clone(),
            ready: (mechanism, variable, source),
            asked,
        };
        let (stretches, events, looked) = course::walk(&sweep, start, sweep.looks);
        sweep.stretches = stretches;
        sweep.events = events;
        sweep.tell_dead_positions_once();
        sweep.looked = looked;
        if range_is_free {
            sweep.end_where_it_ends();
        }
        sweep.ambiguous = sweep.several_balances();
        if !sweep.ambiguous.is_empty() {
            // Of a force that nobody knows nothing is extreme.
            let mut events = std::mem::take(&mut sweep.events);
            events.retain(|event| match event.kind {
                EventKind::Least { column, .. } | EventKind::Greatest { column, .. } => {
                    sweep.is_told(column, event.at)
                }
                _ => true,
            });
            sweep.events = events;
        }
        sweep.reversals = reversals::reversals(placed, &sweep, over, stated);
        sweep.mend_extremes();
        Ok(sweep)
    }

    /// A dead position in which several divisors vanish for the same links is one: each of their roots is known to its rounding.
    fn tell_dead_positions_once(&mut self) {
        /// Of the size of the input's numbers.
        const ONE: f64 = 1e-9;
        let room = ONE * self.size();
        let mut told: Vec<Event> = Vec::new();
        for event in std::mem::take(&mut self.events) {
            let same = |other: &Event| {
                other.kind == EventKind::DeadPosition
                    && (event.at - other.at).abs() <= room
                    && self.links(&event) == self.links(other)
            };
            if event.kind != EventKind::DeadPosition || !told.iter().any(same) {
                told.push(event);
            }
        }
        self.events = told;
    }

    /// Cuts a range that nobody stated down to what is reached without taking the mechanism apart.
    fn end_where_it_ends(&mut self) {
        let reached = || self.stretches.iter().filter(|s| !s.apart);
        let from = reached().map(|s| s.from).fold(f64::INFINITY, f64::min);
        let to = reached().map(|s| s.to).fold(f64::NEG_INFINITY, f64::max);
        if from < to {
            self.whole_turn &= self.range == [from, to];
            self.range = [from, to];
            self.stretches.retain(|s| !s.apart);
            self.events.retain(|e| (from..=to).contains(&e.at));
        }
    }

    /// At so many places of the range one sees everything that happens: as many for every turn.
    #[must_use]
    pub fn looks(&self) -> u32 {
        self.looks
    }

    /// At how many positions the walk has looked, those of the searches for events among them: some 750 for every turn,
    /// and some thirty for every event.
    #[must_use]
    pub fn looked(&self) -> u64 {
        self.looked
    }

    fn measures(&self) -> &[Measure] {
        &self.measures
    }

    /// The name of what is extreme in an event with this column.
    #[must_use]
    pub fn name_of_extreme(&self, column: usize) -> String {
        let of = &self.columns[column];
        if self.measures.contains(&Measure::Column(column)) {
            of.name()
        } else {
            format!("|{}|", of.asked.name)
        }
    }

    /// The program of all columns, written down; its asked numbers are those of the columns in order, and after them three
    /// for each of the centres.
    #[must_use]
    pub fn listing(&self) -> Listing {
        self.transcribed.program.listing()
    }

    /// How many operations one position takes.
    #[must_use]
    pub fn operations(&self) -> usize {
        self.transcribed.lean.len()
    }

    /// Whether every meet is taken on the same side in two stretches: nothing has happened between them.
    #[must_use]
    pub fn is_one_assembly(&self, a: &Stretch, b: &Stretch) -> bool {
        let program = &self.transcribed.program;
        let chords = 0..program.chord_count();
        // Inside a trial a side may change on the way, and nothing happens to the mechanism.
        chords
            .filter(|&chord| !program.is_of_trial(chord))
            .all(|chord| a.signs.get(chord) == b.signs.get(chord))
    }

    /// The stretch in which a place lies.
    #[must_use]
    pub fn stretch_at(&self, at: f64) -> Option<&Stretch> {
        self.stretches.iter().find(|s| (s.from..=s.to).contains(&at))
    }

    /// What tells how that moves which goes to and fro: of pins on guides of the frame places, velocities and
    /// accelerations, of links pivoted to it their angle, ω and α.
    #[must_use]
    pub fn of_outputs(&self) -> Vec<Quantity> {
        let mut outputs: Vec<Quantity> = Vec::new();
        for column in self.columns.iter().filter(|column| column.motion) {
            let of = match column.asked.quantity {
                at @ Quantity::Position(p) => [at, Quantity::Velocity(p), Quantity::Acceleration(p)],
                at @ Quantity::Angle(l) => [at, Quantity::Omega(l), Quantity::Alpha(l)],
                _ => continue,
            };
            if !outputs.contains(&of[0]) {
                outputs.extend(of);
            }
        }
        outputs
    }

    /// The mechanism at one place: every column with its derivative by the input; `None` where it cannot be
    /// assembled.
    #[must_use]
    pub fn at(&self, at: f64) -> Option<Vec<Option<Dual>>> {
        let stretch = self.stretch_at(at)?;
        let mut place = Workspace::default();
        Some(self.look(at, &stretch.signs, &mut place))
    }

    /// Whether points of wheels are carried along: where they stand adds up from the scene's own place on, and no
    /// drawing of one position tells it.
    #[must_use]
    pub fn is_carried_along(&self) -> bool {
        !self.rolling.is_empty()
    }

    /// Whether groups of higher class are found by trial.
    #[must_use]
    pub fn tries(&self) -> bool {
        self.transcribed.program.tries()
    }

    fn look(&self, at: f64, signs: &[f64], place: &mut Workspace) -> Vec<Option<Dual>> {
        let program = &self.transcribed.program;
        // A limit or a dead position was searched for, and stands no nearer than a rounding of the range: what is divided by
        // there is known no better, however well the place itself is written.
        let seam = course::seam(self);
        let ends = |event: &&Event| matches!(event.kind, EventKind::Limit | EventKind::DeadPosition);
        let at_end = self.events.iter().filter(ends).any(|event| (event.at - at).abs() <= seam);
        let told: Vec<bool> = if at_end {
            program.look_within(at, seam, signs, place);
            program.known(place).collect()
        } else {
            vec![true; self.columns.len()]
        };
        let ambiguous = self.is_ambiguous(at);
        program.look(at, signs, place);
        program
            .asked(place)
            .zip(program.known(place).zip(told))
            .zip(&self.columns)
            .map(|((m, (known, told)), column)| {
                let known = column.is_of_position() || known && told;
                let balanced = !ambiguous || !column.is_of_balance();
                (m.value.is_finite() && known && balanced).then(|| column.counted(m))
            })
            .collect()
    }

    /// Whether a column is known at a place, as far as friction leaves one balance there.
    fn is_told(&self, column: usize, at: f64) -> bool {
        !(self.columns[column].is_of_balance() && self.is_ambiguous(at))
    }

    /// Computes the asked columns at many places, in blocks and without allocation for each: `take` gets the place
    /// and its numbers. Numbers at events of the course (which see) mean nothing.
    pub fn run(&self, places: &[f64], mut take: impl FnMut(f64, &[f64])) {
        let program = &self.transcribed.lean;
        let mut block = program.block();
        let mut row = vec![0.0; self.columns.iter().filter(|c| !c.watched).count()];
        for (stretch, inside) in self.parts(places) {
            for chunk in inside.chunks(LANES) {
                let mut lane: Lane = [chunk.last().copied().unwrap_or(0.0); LANES];
                lane[..chunk.len()].copy_from_slice(chunk);
                program.run(&lane, &stretch.signs, &mut block);
                for (index, &at) in chunk.iter().enumerate() {
                    for ((to, from), column) in row.iter_mut().zip(block.asked(program)).zip(&self.columns) {
                        *to = if column.is_unsigned() { from[index].abs() } else { from[index] };
                    }
                    take(at, &row);
                }
            }
        }
    }

    /// The places that lie in each stretch; one that lies between two belongs to the first.
    fn parts<'a>(&'a self, places: &'a [f64]) -> impl Iterator<Item = (&'a Stretch, &'a [f64])> {
        let mut taken = 0;
        self.stretches.iter().map(move |stretch| {
            let from = places.partition_point(|p| *p < stretch.from).max(taken);
            let to = places.partition_point(|p| *p <= stretch.to).max(from);
            taken = to;
            (stretch, &places[from..to])
        })
    }

    /// Positions at these places, ascending; those that cannot be assembled are left out.
    #[must_use]
    pub fn positions(&self, places: &[f64]) -> Vec<Position> {
        let mut positions = Vec::new();
        self.each_position(places, |at, values| positions.push(Position { at, values: values.to_vec() }));
        positions
    }

    /// As [`Sweep::positions`], without keeping them: `take` gets the place and one number for each column.
    pub fn each_position(&self, places: &[f64], mut take: impl FnMut(f64, &[Option<f64>])) {
        let mut place = Workspace::default();
        let mut values = Vec::new();
        for &at in places {
            let Some(stretch) = self.stretch_at(at) else { continue };
            values.clear();
            values.extend(self.look(at, &stretch.signs, &mut place).into_iter().map(|v| v.map(|m| m.value)));
            take(at, &values);
        }
    }

    /// `steps` equal steps over the range: one place more than steps.
    #[must_use]
    pub fn equal_steps(&self, steps: u32) -> Vec<f64> {
        let [from, to] = self.range;
        let steps = steps.max(1);
        let whole = f64::from(steps);
        // Weighted from both ends, so that both are met and round numbers stay round.
        let between = |i: f64| from * ((whole - i) / whole) + to * (i / whole);
        (0..=steps).map(|i| if i == steps { to } else { between(f64::from(i)) }).collect()
    }

    /// Places so close together that between two of them no column strays from the straight line by more
    /// than `tolerance` times its own range, or than its own rounding. What grows without end is followed up to twice
    /// its range elsewhere. At most [`MOST_PLACES`] to each of the parts into which a stretch is first cut.
    #[must_use]
    pub fn adapted(&self, tolerance: f64) -> Vec<f64> {
        /// A stretch is first cut into so many parts.
        const PARTS: u32 = 16;
        let mut place = Workspace::default();
        let mut places = Vec::new();
        let mut look = |at: f64, signs: &[f64]| (at, self.look(at, signs, &mut place));
        for stretch in &self.stretches {
            let parts = PARTS * (self.looks / LOOKS);
            let step = (stretch.to - stretch.from) / f64::from(parts);
            let first: Vec<Node> = (0..=parts)
                .map(|i| if i == parts { stretch.to } else { stretch.from + step * f64::from(i) })
                .map(|at| look(at, &stretch.signs))
                .collect();
            let ranges = ranges(&first);
            places.push(stretch.from);
            for pair in first.windows(2) {
                let mut at = |x: f64| look(x, &stretch.signs);
                let most = places.len() + MOST_PLACES;
                divide(
                    &mut at,
                    [&pair[0], &pair[1]],
                    (&ranges, tolerance),
                    (MOST_HALVINGS, most),
                    &mut places,
                );
            }
        }
        places.dedup();
        places
    }

    /// The motions to and fro, where the input goes all the way round: columns with just one least and one
    /// greatest value.
    #[must_use]
    pub fn strokes(&self) -> Vec<SliderStroke> {
        let round = self.whole_turn && self.stretches.iter().all(|s| !s.apart) && {
            let covered: f64 = self.stretches.iter().map(|s| s.to - s.from).sum();
            covered >= (self.range[1] - self.range[0]) * (1.0 - f64::EPSILON * 8.0)
        };
        if !round {
            return Vec::new();
        }
        let mut strokes = Vec::new();
        for (index, column) in self.columns.iter().enumerate() {
            let (mut least, mut greatest) = (Vec::new(), Vec::new());
            for event in &self.events {
                match event.kind {
                    EventKind::Least { column, value } if column == index => least.push((event.at, value)),
                    EventKind::Greatest { column, value } if column == index => {
                        greatest.push((event.at, value));
                    }
                    _ => {}
                }
            }
            if let (true, &[(low_at, low)], &[(high_at, high)]) =
                (column.motion, least.as_slice(), greatest.as_slice())
            {
                let turn = self.range[1] - self.range[0];
                let way = (high_at - low_at).abs();
                let (quick, slow) = (way.min(turn - way), way.max(turn - way));
                let across = column.axis.map_or(0.0, |axis| self.along_with(index, axis, [low_at, high_at]));
                strokes.push(SliderStroke {
                    column: index,
                    length: libm::hypot(high - low, across),
                    ends: [low_at, high_at],
                    time_ratio: slow / quick,
                });
            }
        }
        // A pin on an oblique guide has the same stroke in both coordinates: told once.
        strokes.dedup_by(|b, a| {
            let same = self.columns[a.column].asked.quantity == self.columns[b.column].asked.quantity;
            same && self.columns[a.column].axis.is_some()
        });
        strokes
    }

    /// How far the other coordinate of a place moves between two places of the input.
    fn along_with(&self, column: usize, axis: usize, ends: [f64; 2]) -> f64 {
        let other = if axis == 0 { column + 1 } else { column - 1 };
        let value = |at: f64| self.at(at).and_then(|values| values.get(other).copied().flatten());
        match ends.map(value) {
            [Some(a), Some(b)] => b.value - a.value,
            _ => 0.0,
        }
    }

    /// The links that stand in line at an event.
    #[must_use]
    pub fn links(&self, event: &Event) -> &[u32] {
        event.reason.map_or(&[], |reason| self.transcribed.links(reason))
    }

    /// The points of a link of the mechanism that moves.
    #[must_use]
    pub fn points_of(&self, link: LinkId) -> &[PointId] {
        &self.ready.0.link(link).points
    }

    /// The links that stand in line where a divisor of each reason vanishes.
    #[must_use]
    pub fn reasons(&self) -> &[Vec<u32>] {
        &self.transcribed.reasons
    }

    /// How friction is stuck where a divisor of each reason vanishes, where it is that.
    #[must_use]
    pub fn stuck(&self) -> &[Option<Stuck>] {
        &self.transcribed.stuck
    }

    /// The size of the input's numbers, by which its rounding is measured.
    fn size(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    /// The same sweep beside another mechanism, away from the scene's own place: for whoever looks whether that is found.
    #[cfg(test)]
    pub(crate) fn beside(mut self, change: impl Fn(&mut Mechanism)) -> Self {
        change(&mut self.ready.0);
        self
    }

    pub(crate) fn transcribed(&self) -> &Transcribed {
        &self.transcribed
    }
}

/// At how many places to look, by how often anything turns round in the range.
fn looks(variable: &Variable, mechanism: &Mechanism, [from, to]: [f64; 2]) -> Result<u32, SweepError> {
    let way = |input: &Input, index: usize| match (variable, input) {
        (_, Input::Slide { .. }) => 0.0,
        (Variable::Input(swept), _) => {
            if *swept == index {
                to - from
            } else {
                0.0
            }
        }
        (Variable::Time(laws), _) => laws.get(index).map_or(0.0, |law| {
            let fastest = [from, to].map(|t| (law.rate.value + law.acceleration.value * t).abs());
            (to - from) * fastest[0].max(fastest[1])
        }),
    };
    let ways = mechanism.inputs.iter().enumerate().map(|(index, input)| way(input, index));
    let turns = (ways.fold(0.0, f64::max) / std::f64::consts::TAU).max(1.0);
    if turns.is_nan() || turns > MOST_TURNS {
        return Err(SweepError::Range(format!("the input turns more than {MOST_TURNS} times in this range")));
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most MOST_TURNS")]
    let turns = turns.ceil() as u32;
    Ok(LOOKS * turns)
}

type Node = (f64, Vec<Option<Dual>>);

/// Smallest and largest value of each column.
fn ranges(nodes: &[Node]) -> Vec<[f64; 2]> {
    let columns = nodes.first().map_or(0, |n| n.1.len());
    (0..columns)
        .map(|c| {
            let mut values: Vec<f64> = nodes.iter().filter_map(|n| n.1[c]).map(|m| m.value).collect();
            values.sort_by(f64::total_cmp);
            // Without the outermost twentieth: at a limit speeds grow without end.
            let cut = values.len() / 20;
            match (values.get(cut), values.get(values.len().saturating_sub(1 + cut))) {
                (Some(&low), Some(&high)) => [low, high],
                _ => [0.0; 2],
            }
        })
        .collect()
}

fn divide(
    look: &mut impl FnMut(f64) -> Node,
    [from, to]: [&Node; 2],
    (ranges, tolerance): (&[[f64; 2]], f64),
    (left, most): (u32, usize),
    places: &mut Vec<f64>,
) {
    let middle = look(f64::midpoint(from.0, to.0));
    let strays = (0..ranges.len()).any(|c| match (from.1[c], middle.1[c], to.1[c]) {
        (Some(a), Some(m), Some(b)) => {
            let [low, high] = ranges[c];
            let range = high - low;
            // What has gone as far beyond its range grows without end, and is not followed.
            let followed = (low - range..=high + range).contains(&m.value);
            // A constant has no range but its rounding.
            let rounding = course::ERRORS * (a.error + m.error + b.error);
            let stray = (m.value - f64::midpoint(a.value, b.value)).abs();
            followed && stray > (tolerance * range).max(rounding)
        }
        _ => false,
    });
    if strays && left > 0 && places.len() < most {
        divide(look, [from, &middle], (ranges, tolerance), (left - 1, most), places);
        divide(look, [&middle, to], (ranges, tolerance), (left - 1, most), places);
    } else {
        places.push(to.0);
    }
}
