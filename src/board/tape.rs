//! What the board remembers: every operation with its operands, and the strokes.
//!
//! The tape is a list of scalar results. Each is a number from outside (a [`Leaf`]) or an operation ([`Op`]) on earlier
//! ones. Nothing is decided by it while it is written, but for what the draughtsman asks of an error; whoever wants
//! bounds (`bounds.rs`), or the same drawing for other places of its inputs (`program.rs`), evaluates it afterwards.

use std::fmt::Debug;

use super::bounds::Bounds;
use super::hand::{Dice, Hand, Pencil};
use super::op::{MOST_OPERANDS, Op};
use super::scalar::{Arithmetic, Real};
use crate::double_double::DoubleDouble;
use crate::given::Given;
use crate::wide::Wide;

/// Which of the board's operations made a stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Operation {
    /// A place pricked from given coordinates.
    Prick,
    /// A length laid off from a point along a direction.
    LayOff,
    /// The meet of two lines.
    MeetLines,
    /// The meet of a line and a circle.
    MeetLineCircle,
    /// The meet of two circles.
    MeetCircles,
    /// A line divided in a ratio.
    Divide,
    /// The corner of a figure similar to a given one.
    Similar,
    /// The foot of a perpendicular.
    Foot,
}

impl Operation {
    /// The word of the text tape.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Prick => "prick",
            Self::LayOff => "lay off",
            Self::MeetLines => "meet line line",
            Self::MeetLineCircle => "meet line circle",
            Self::MeetCircles => "meet circle circle",
            Self::Divide => "divide",
            Self::Similar => "similar",
            Self::Foot => "foot",
        }
    }
}

/// A point that the draughtsman made, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointRecord {
    /// The operation.
    pub operation: Operation,
    /// The point in paper millimetres.
    pub at: [f64; 2],
    /// Tape slots of its two coordinates.
    pub slots: [u32; 2],
    /// What it was drawn for.
    pub purpose: &'static str,
}

/// Why a division may fail: an index into the list that the caller of the board keeps.
pub type Reason = u32;

/// A number that comes from outside the drawing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Leaf {
    /// The number with all its digits.
    pub(super) given: Given,
    /// How far the number in the tape's own arithmetic may be off.
    pub(super) error: f64,
    /// What it is to the drawing.
    pub(super) role: Role,
}

/// What a number from outside is to the drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Role {
    /// A number of the scene, or of the draughtsman's own choice.
    Given,
    /// The place of the input of this index.
    Input(usize),
    /// How fast the input of this index moves.
    Rate(usize),
    /// Found by trial: whoever runs the drawing for another place has to find it anew.
    Tried,
    /// The slip of a human hand.
    Slip,
}

/// What a scalar result is.
#[derive(Debug, Clone, Copy)]
pub(super) enum Node {
    /// The number from outside of this index.
    Leaf(u32),
    /// An operation on earlier results; operands that it does not take are 0.
    Made(Op, [u32; MOST_OPERANDS]),
}

/// The same as it stands on the tape: numbers of equal size in fixed places, which a processor writes without a detour.
#[derive(Debug, Clone, Copy)]
pub(super) struct Entry {
    /// The operands of an operation; of a number from outside its index, first.
    of: [u32; MOST_OPERANDS],
    made: Option<Op>,
}

impl Entry {
    fn leaf(index: u32) -> Self {
        let mut of = [0; MOST_OPERANDS];
        of[0] = index;
        Self { of, made: None }
    }

    /// What stands there.
    #[inline]
    pub(super) fn node(self) -> Node {
        match self.made {
            Some(op) => Node::Made(op, self.of),
            None => Node::Leaf(self.of[0]),
        }
    }

    /// The earlier results that it is made of.
    #[inline]
    pub(super) fn operands(&self) -> &[u32] {
        &self.of[..self.made.map_or(0, Op::operands)]
    }
}

/// An open constraint that was met by trial: what is tried stands where nothing is missed, and one step of false position
/// with the slope of the miss follows from there as ordinary operations. By marks of the tape, or slots of a transcript.
#[derive(Debug, Clone, Copy)]
pub(super) struct Trial {
    /// Where what is tried was found to stand.
    pub(super) found: u32,
    /// By how much the constraint is missed there.
    pub(super) miss: u32,
    /// How the miss changes with what is tried.
    pub(super) slope: u32,
    /// Where it stands after the step of false position.
    pub(super) corrected: u32,
    /// How far what is tried may go at once: one radian, or a length of the paper.
    pub(super) unit: f64,
}

impl Trial {
    /// The same by other handles.
    pub(super) fn by(self, handle: impl Fn(u32) -> u32) -> Self {
        Self {
            found: handle(self.found),
            miss: handle(self.miss),
            slope: handle(self.slope),
            corrected: handle(self.corrected),
            unit: self.unit,
        }
    }
}

/// What happens between two operations.
#[derive(Debug, Clone, Copy)]
pub(super) enum Event {
    /// A number of this size is divided by, and must exceed its error.
    Divisor { slot: u32, value: f64, reason: Reason },
    /// These two numbers are a point of the drawing.
    Point([u32; 2]),
}

/// A stroke to be moved after it is drawn, in paper millimetres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nudge {
    /// Index into [`Tape::strokes`].
    pub stroke: usize,
    /// By how much.
    pub by: [f64; 2],
}

/// The results in an arithmetic that doubles do not hold.
#[derive(Debug, Clone, Default)]
enum Fine {
    #[default]
    None,
    DoubleDouble(Vec<DoubleDouble>),
    Wide(Vec<Wide>),
}

/// What counts as the error of a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Errors {
    /// The roundings of its arithmetic, and what its numbers may mean.
    Roundings,
    /// The slips of a hand; roundings count for nothing.
    Slips(Hand),
}

/// The record of a drawing.
#[derive(Debug, Clone)]
pub struct Tape {
    pub(super) arithmetic: Arithmetic,
    pub(super) errors: Errors,
    /// Scratch paper has no record.
    keeps: bool,
    /// Whether the draughtsman may ask how large an error is.
    judges: bool,
    /// Points that are made now are no strokes of the drawing.
    aside: bool,
    /// Where what was done beside the drawing begins and ends, in turns.
    pub(super) asides: Vec<u32>,
    pub(super) nodes: Vec<Entry>,
    /// The results, rounded to doubles.
    pub(super) values: Vec<f64>,
    fine: Fine,
    pub(super) leaves: Vec<Leaf>,
    pub(super) trials: Vec<Trial>,
    /// What happens, each before the operation of this index.
    pub(super) events: Vec<(u32, Event)>,
    /// Factors that stand on the tape already.
    factors: Vec<(u64, u32)>,
    strokes: Vec<PointRecord>,
    nudge: Option<Nudge>,
    dice: Option<Dice>,
    pub(super) bounds: Bounds,
}

impl Default for Tape {
    fn default() -> Self {
        Self::of(Arithmetic::Double)
    }
}

/// Room for so many results from the first on: those of a four-bar.
const FEW: usize = 512;

/// At most so many factors are looked through before one is written again.
const FACTORS: usize = 24;

impl Tape {
    /// A clean tape for a drawing with bounds, in this arithmetic.
    #[must_use]
    pub fn of(arithmetic: Arithmetic) -> Self {
        let fine = match arithmetic {
            Arithmetic::Single | Arithmetic::Double => Fine::None,
            Arithmetic::DoubleDouble => Fine::DoubleDouble(Vec::new()),
            Arithmetic::Wide => Fine::Wide(Vec::new()),
        };
        Self {
            arithmetic,
            errors: Errors::Roundings,
            keeps: true,
            judges: true,
            aside: false,
            asides: Vec::new(),
            nodes: Vec::new(),
            values: Vec::new(),
            fine,
            leaves: Vec::new(),
            trials: Vec::new(),
            events: Vec::new(),
            factors: Vec::new(),
            strokes: Vec::new(),
            nudge: None,
            dice: None,
            bounds: Bounds::default(),
        }
    }

    /// Scratch paper: no bounds, and no record where the arithmetic can do without one.
    #[must_use]
    pub fn scratch(arithmetic: Arithmetic) -> Self {
        let keeps = !matches!(arithmetic, Arithmetic::Single | Arithmetic::Double);
        Self { keeps, judges: false, ..Self::of(arithmetic) }
    }

    /// A tape of a drawing in double precision in which nothing is decided by an error: to be run for other places.
    #[must_use]
    pub fn to_be_run() -> Self {
        Self { judges: false, ..Self::default() }
    }

    /// Whether the drawing will be run for other places, so that what is decided by looking holds there only where the
    /// tape itself says so.
    #[must_use]
    pub fn will_be_run(&self) -> bool {
        self.keeps && !self.judges
    }

    /// A tape on which one stroke will be moved as it is drawn.
    #[must_use]
    pub fn nudged(nudge: Nudge) -> Self {
        Self { nudge: Some(nudge), ..Self::default() }
    }

    /// The tape of a perfect drawing by this hand, for what every slip would do to it.
    #[must_use]
    pub fn by_hand(hand: Hand) -> Self {
        Self { errors: Errors::Slips(hand), ..Self::default() }
    }

    /// Scratch paper before a draughtsman whose hand slips by lot; the same seed slips the same way.
    #[must_use]
    pub fn trembling(hand: Hand, seed: u64) -> Self {
        Self { dice: Some(Dice::new(hand, seed)), ..Self::scratch(Arithmetic::Double) }
    }

    /// Whether a hand draws here whose slips are thrown by dice.
    #[must_use]
    pub fn trembles(&self) -> bool {
        self.dice.is_some()
    }

    /// Whether operations are recorded, so that numbers have bounds.
    #[must_use]
    pub fn keeps(&self) -> bool {
        self.keeps
    }

    /// Begins or ends what is done beside the drawing: its points are no strokes.
    pub fn aside(&mut self, aside: bool) {
        if self.aside != aside {
            self.asides.push(self.next());
        }
        self.aside = aside;
    }

    /// Whether an operation was made beside the drawing.
    pub(super) fn is_aside(&self, index: usize) -> bool {
        self.asides.partition_point(|change| *change as usize <= index) % 2 == 1
    }

    /// The arithmetic of the drawing.
    #[must_use]
    pub fn arithmetic(&self) -> Arithmetic {
        self.arithmetic
    }

    /// How many results stand on the tape, those from outside among them.
    #[must_use]
    pub fn operations(&self) -> usize {
        self.nodes.len()
    }

    /// The strokes in the order of drawing.
    #[must_use]
    pub fn strokes(&self) -> &[PointRecord] {
        &self.strokes
    }

    /// A result with this value in an arithmetic of choice: all the digits that the tape has of it.
    #[must_use]
    pub fn number<R: Real>(&self, mark: u32, value: f64) -> R {
        let index = mark as usize;
        match &self.fine {
            Fine::None => R::from_f64(value),
            Fine::DoubleDouble(column) => {
                column.get(index).map_or(R::from_f64(value), |&n| R::from_double_double(n))
            }
            Fine::Wide(column) => column.get(index).map_or(R::from_f64(value), |&n| R::from_wide(n)),
        }
    }

    fn next(&self) -> u32 {
        u32::try_from(self.nodes.len()).unwrap_or(u32::MAX)
    }

    /// Writes a number from outside down; its value and its mark, and whether the arithmetic holds it.
    pub(super) fn leaf(&mut self, given: Given, role: Role) -> (f64, u32, bool) {
        let (value, error, finite) = match &mut self.fine {
            Fine::None if self.arithmetic == Arithmetic::Single => nearest::<f32>(given).to_doubles(),
            Fine::None => nearest::<f64>(given).to_doubles(),
            Fine::DoubleDouble(column) => nearest::<DoubleDouble>(given).push(column),
            Fine::Wide(column) => nearest::<Wide>(given).push(column),
        };
        if !self.keeps {
            return (value, 0, finite);
        }
        if self.nodes.is_empty() {
            self.nodes.reserve(FEW);
            self.values.reserve(FEW);
        }
        let mark = self.next();
        self.nodes.push(Entry::leaf(u32::try_from(self.leaves.len()).unwrap_or(u32::MAX)));
        self.values.push(value);
        self.leaves.push(Leaf { given, error, role });
        (value, mark, finite)
    }

    /// The mark of an exact factor.
    pub(super) fn factor(&mut self, factor: f64) -> (f64, u32) {
        if self.keeps {
            let known = self.factors.iter().rev().take(FACTORS).find(|(bits, _)| *bits == factor.to_bits());
            if let Some(&(_, mark)) = known {
                return (self.values[mark as usize], mark);
            }
        }
        let (value, mark, _) = self.leaf(Given::exact(factor), Role::Given);
        if self.keeps {
            self.factors.push((factor.to_bits(), mark));
        }
        (value, mark)
    }

    /// Writes an operation down that comes to this value.
    #[inline(always)]
    fn write(&mut self, op: Op, of: [u32; MOST_OPERANDS], value: f64) -> u32 {
        if !self.keeps {
            return 0;
        }
        let mark = self.next();
        self.nodes.push(Entry { of, made: Some(op) });
        self.values.push(value);
        mark
    }

    /// An operation on numbers with these marks and values. Says whether the arithmetic holds the result: where it does
    /// not, zero stands in its place. Inlined for each operation of the board: nothing on the way is done as often.
    #[inline(always)]
    pub(super) fn operate(
        &mut self,
        op: Op,
        of: [u32; MOST_OPERANDS],
        values: [f64; MOST_OPERANDS],
    ) -> (f64, u32, bool) {
        if self.arithmetic == Arithmetic::Double {
            let result = finite(op.value(values));
            return (result.0, self.write(op, of, result.0), result.1);
        }
        let (value, is_finite) = self.operate_in(op, of, values);
        (value, self.write(op, of, value), is_finite)
    }

    /// The same in another arithmetic than doubles.
    #[inline(never)]
    fn operate_in(&mut self, op: Op, of: [u32; MOST_OPERANDS], values: [f64; MOST_OPERANDS]) -> (f64, bool) {
        fn in_column<R: Real>(op: Op, of: [u32; MOST_OPERANDS], column: &mut Vec<R>) -> (f64, bool) {
            let zero = R::from_f64(0.0);
            let mut at = of.map(|mark| column.get(mark as usize).copied().unwrap_or(zero));
            at[op.operands()..].fill(zero);
            let (value, is_finite) = finite(op.value(at));
            column.push(value);
            (value.to_f64(), is_finite)
        }
        match &mut self.fine {
            Fine::None => {
                let (value, is_finite) = finite(op.value(values.map(<f32 as Real>::from_f64)));
                (value.to_f64(), is_finite)
            }
            Fine::DoubleDouble(column) => in_column(op, of, column),
            Fine::Wide(column) => in_column(op, of, column),
        }
    }

    /// Zero in the place of a quotient that is no number, or whose derivatives are none.
    pub(super) fn no_quotient(&mut self, of: [u32; MOST_OPERANDS]) -> u32 {
        match &mut self.fine {
            Fine::None => {}
            Fine::DoubleDouble(column) => column.push(DoubleDouble::of(0.0)),
            Fine::Wide(column) => column.push(Wide::of(0.0)),
        }
        self.write(Op::Quotient, of, 0.0)
    }

    /// A number that is divided by must exceed its error, or what follows from it is indeterminate for this reason.
    #[inline]
    pub(super) fn divisor(&mut self, slot: u32, value: f64, reason: Reason) {
        if self.keeps {
            self.events.push((self.next(), Event::Divisor { slot, value, reason }));
        }
    }

    /// Whether a result hangs on a division by what may be zero, where the draughtsman may ask.
    pub(super) fn is_weak(&mut self, mark: u32) -> bool {
        self.judges && self.weakness(mark).is_some()
    }

    /// How large the error of a result is, where the draughtsman may ask.
    pub(super) fn error(&mut self, mark: u32) -> Option<f64> {
        self.judges.then(|| self.total_error(mark))
    }

    /// Notes that an open constraint was met by trial.
    pub(super) fn tried(&mut self, trial: Trial) {
        if self.keeps {
            self.trials.push(trial);
        }
    }

    /// The slip of the hand in one act, in millimetres or radians, and its mark; `None` where the hand is perfect.
    pub(super) fn slip(&mut self, kind: Pencil) -> Option<(f64, u32)> {
        if let Some(dice) = &mut self.dice {
            return Some((dice.slip(kind), 0));
        }
        let Errors::Slips(hand) = self.errors else { return None };
        let (value, mark, _) = self.leaf(Given::within(0.0, hand.slip(kind)), Role::Slip);
        Some((value, mark))
    }

    /// A point was made. What comes back is added to its place: zero, but for tests that nudge a stroke.
    pub(super) fn stroke(
        &mut self,
        operation: Operation,
        at: [f64; 2],
        marks: [u32; 2],
        purpose: &'static str,
    ) -> [f64; 2] {
        if !self.keeps || self.aside || self.errors != Errors::Roundings {
            return [0.0; 2];
        }
        let by = match self.nudge {
            Some(nudge) if nudge.stroke == self.strokes.len() => nudge.by,
            _ => [0.0; 2],
        };
        let at = [at[0] + by[0], at[1] + by[1]];
        self.events.push((self.next(), Event::Point(marks)));
        self.strokes.push(PointRecord { operation, at, slots: marks, purpose });
        by
    }
}

/// The nearest number of an arithmetic to one that was stated, and how far that is true.
struct Nearest<R> {
    value: R,
    error: f64,
    finite: bool,
}

fn nearest<R: Real>(given: Given) -> Nearest<R> {
    let (value, error) = R::from_given(given);
    let (value, finite) = finite(value);
    Nearest { value, error, finite }
}

impl<R: Real> Nearest<R> {
    fn to_doubles(&self) -> (f64, f64, bool) {
        (self.value.to_f64(), self.error, self.finite)
    }

    fn push(self, column: &mut Vec<R>) -> (f64, f64, bool) {
        column.push(self.value);
        self.to_doubles()
    }
}

/// The number, or zero and `false` where the arithmetic has run over. Zero has no sign: whether a half turn is one to the
/// left or to the right must not depend on how a zero came about, for evaluators drop what is multiplied by it.
#[inline]
fn finite<R: Real>(value: R) -> (R, bool) {
    let zero = R::from_f64(0.0);
    if value.to_f64().is_finite() { (value + zero, true) } else { (zero, false) }
}
