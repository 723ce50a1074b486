//! The turning-moment diagram on the board: the curves over the angle, the mean line, their meets, the areas between as
//! sums of trapezia and parabolic pieces, and the running levels.
//!
//! Angles run to the right from 0, torques upwards. Where the angle of the input falls everything is drawn over what has
//! been turned since angle 0, and told by the angle of the input. A harmonic is the height of a turning arrow, read off
//! when it stands at its angle. Where both curves are straight an area is a trapezium and a crossing the meet of two lines;
//! elsewhere pieces are so short that a parabola through three heights misses less than is told in the bound, and a
//! crossing is found by false position.

use crate::board::{Amount, Arithmetic, Board, Line, Mm, Point, Reason, Scale, Tape};
use crate::given::Given;
use crate::mechanism::cycle::{Course, Cycle, CycleQuantity, RotatingInertia, Sides};
use crate::mechanism::quantity::{Answer, Indeterminate};

use super::curve::{Curved, Limit};

/// A mechanism's own torque over the angle of its input.
#[derive(Clone, Copy)]
pub struct OwnTorque<'a> {
    /// What it is at an angle: N m, and how far it may be off; none where it is not determined.
    pub at: &'a dyn Fn(f64) -> Option<(f64, f64)>,
    /// Where the curves of its loads bend or leap: an angle, and after which angle it comes again.
    pub knots: &'a [[Given; 2]],
}

/// A weak divisor has no better name here.
const REASON: Reason = 0;
/// Two angles of the scene nearer than this part of the period are one.
const SAME: f64 = 1e-14;
/// Less than this part of the largest torque is zero.
const ZERO: f64 = 1e-12;
/// By this part of the largest torque a parabola may miss its piece.
const MISS: f64 = 3e-11;
/// Where a curve has a corner pieces end at this part of the largest area.
const CORNER: f64 = 1e-14;
/// A piece is halved so often at most.
const HALVINGS: u32 = 40;
/// Pieces of a curve before any is halved.
const PIECES: u32 = 48;
/// Steps of a period in which its energy is drawn.
const DRAWN: u32 = 240;
/// So near the beginning of the period, as a part of it, no crossing is surely the first or the last.
const BEGINNING: f64 = 1e-9;
/// Curves that part by no more than so many zeros between two crossings all but touch.
const TOUCH: f64 = 1e3;
/// Two curves must have one mean within this part.
const ONE_MEAN: f64 = 1e-3;

/// A turning-moment diagram as drawn, in SI units and radians.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct CycleSheet {
    /// After which angle everything comes again.
    pub period: f64,
    /// The driving and the resisting torque: points of the curves; none where only areas are given.
    pub curves: [Vec<[f64; 2]>; 2],
    /// Which of the two is a line at the mean of the other.
    pub constant: Option<usize>,
    /// The angle of the input falls as time goes on.
    pub falling: bool,
    /// Where the curves cross, in the order of the motion from angle 0: with a falling angle one at 0, then descending.
    pub crossings: Vec<CycleCrossing>,
    /// Areas between them: from each crossing to the next, or as they were given.
    pub areas: Vec<f64>,
    /// The levels of energy: at each crossing, or after each given area.
    pub levels: Vec<f64>,
    /// The energy over the angle, J, from its beginning on in the sense of the motion; none where only areas are given.
    pub energy: Vec<[f64; 2]>,
    /// Which level is the highest, and which the lowest.
    pub extremes: Option<[usize; 2]>,
    /// What was read off.
    numbers: Vec<(CycleQuantity, Answer)>,
}

/// A crossing of the two curves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CycleCrossing {
    /// The angle.
    pub at: f64,
    /// The torque there; of a leap the mean torque.
    pub torque: f64,
    /// The driving torque comes from below as the motion goes on: speed is least here.
    pub rises: bool,
}

impl CycleSheet {
    /// What was read off for a quantity.
    #[must_use]
    pub fn answer(&self, of: CycleQuantity) -> Answer {
        let found = self.numbers.iter().find(|(known, _)| *known == of);
        found.map_or_else(|| undefined("it was not drawn"), |(_, answer)| answer.clone())
    }
}

fn undefined(why: impl Into<String>) -> Answer {
    Answer::Indeterminate(Indeterminate::Undefined { why: why.into() })
}

/// Draws a diagram and reads these quantities off.
///
/// # Errors
/// Why there is no diagram, one clause.
pub fn draw(
    arithmetic: Arithmetic,
    cycle: &Cycle,
    g: Given,
    asked: &[CycleQuantity],
    of: Option<OwnTorque<'_>>,
) -> Result<CycleSheet, String> {
    let board = Board::new(Tape::of(arithmetic));
    let mut desk = Desk { board, cycle, of, missed: 0.0, largest: 0.0 };
    let drawn = match &cycle.sides {
        Sides::Areas { areas, torque, angle, total } => desk.by_areas(areas, *torque, *angle, *total)?,
        _ => desk.by_curves()?,
    };
    let mut sheet = drawn.sheet(cycle, desk.board.tape());
    let mut asked = asked.to_vec();
    // What an answer is computed from is told before it.
    for of in asked.clone() {
        asked.extend_from_slice(of.computed_from());
    }
    asked.sort_unstable_by_key(|of| of.name());
    asked.dedup();
    let read: Vec<(CycleQuantity, Result<Number, String>)> =
        asked.into_iter().map(|of| (of, desk.read(&drawn, g, of))).collect();
    let marks: Vec<u32> = read.iter().filter_map(|(_, n)| n.as_ref().ok()).map(|n| n.amount.mark()).collect();
    let mut judged = desk.board.tape().judged(&marks).into_iter();
    for (of, number) in read {
        let answer = match number {
            Err(why) => undefined(why),
            Ok(number) => match judged.next() {
                Some(judged) if judged.weakness.is_none() && judged.bound.is_finite() => {
                    let value = number.amount.value();
                    Answer::Scalar { value, bound: judged.bound + number.beside + value.abs() * f64::EPSILON }
                }
                _ => undefined("it is divided by what may be zero"),
            },
        };
        sheet.numbers.push((of, answer));
    }
    Ok(sheet)
}

/// A number on the tape, and what its bound has besides that of the tape.
#[derive(Debug, Clone, Copy)]
struct Number {
    amount: Amount,
    beside: f64,
}

/// A torque on the board.
enum Drawn {
    Curve(Curved),
    /// What the mechanism gives, and where the curves of its loads have their knots.
    Of {
        sign: f64,
        knots: Vec<Breaks>,
    },
}

/// An angle at which a curve bends or leaps, and after which angle it comes again; both also as they decide.
#[derive(Debug, Clone, Copy)]
struct Breaks {
    at: Amount,
    period: Amount,
    place: f64,
    turn: f64,
}

/// Where a curve bends or leaps.
fn knots_of(course: &Drawn) -> Vec<Breaks> {
    match course {
        Drawn::Curve(Curved::Table(table)) => {
            let knots = table.knots.iter().zip(&table.angles);
            let of = |(knot, place): (&[Amount; 2], &f64)| Breaks {
                at: knot[0],
                period: table.period,
                place: *place,
                turn: table.turn,
            };
            knots.map(of).collect()
        }
        Drawn::Curve(Curved::Harmonics { .. }) => Vec::new(),
        Drawn::Of { knots, .. } => knots.clone(),
    }
}

/// The angle at which a mechanism is asked, so that a curve of its loads that leaps there is on the side from which one
/// comes.
fn beside(knots: &[Breaks], place: f64, limit: Limit) -> f64 {
    let near = |knot: &&Breaks| {
        let away = place - knot.place;
        let away = away - libm::round(away / knot.turn) * knot.turn;
        away.abs() <= SAME * (knot.turn + place.abs())
    };
    match knots.iter().find(near) {
        // Farther than what counts as the knot itself.
        Some(knot) => {
            let by = 4.0 * SAME * (knot.turn + place.abs());
            if limit == Limit::Before { place - by } else { place + by }
        }
        None => place,
    }
}

/// A crossing within a piece: its node, its angle with how far that may be off besides, and the halves of the piece.
type Met = (Node, (Amount, f64), [Piece; 2]);

/// The mean of one curve, at which the other is drawn that is missing.
#[derive(Clone, Copy)]
struct Level {
    side: usize,
    mean: Amount,
    /// The same on scratch paper.
    seen: f64,
}

impl Level {
    fn seen(self) -> (usize, f64) {
        (self.side, self.seen)
    }
}

/// An angle on the board, and as it is on scratch paper: what is drawn is decided there, alike in every arithmetic.
#[derive(Clone, Copy)]
struct Angle {
    at: Amount,
    place: f64,
}

/// A top of a curve between two nodes: where, how high, and within what nothing tells where.
#[derive(Clone, Copy)]
struct Top {
    at: f64,
    height: f64,
    room: f64,
}

/// An angle at which pieces meet, with the heights of both curves on either side of it.
#[derive(Clone, Copy)]
struct Node {
    at: Amount,
    before: [Amount; 2],
    after: [Amount; 2],
    place: f64,
    /// The same heights on scratch paper.
    seen: [[f64; 2]; 2],
    /// A difference of the curves that is not told from zero here.
    zero: f64,
}

impl Node {
    /// Which curve is the higher one before or after the angle; zero where neither is.
    fn sign(&self, limit: Limit) -> f64 {
        let net = self.net(limit);
        if net.abs() <= self.zero { 0.0 } else { net.signum() }
    }

    fn net(&self, limit: Limit) -> f64 {
        let [torque, load] = self.seen[usize::from(limit == Limit::After)];
        torque - load
    }
}

/// What lies between two nodes: the heights in its middle, where it is not straight.
type Piece = Option<[Amount; 2]>;

/// The diagram while it is drawn.
struct Diagram {
    nodes: Vec<Node>,
    /// The mean torque and its work; none where areas alone are given.
    mean: Option<(Amount, Amount)>,
    constant: Option<usize>,
    crossings: Vec<Crossing>,
    areas: Vec<Amount>,
    levels: Vec<Amount>,
    /// What has been turned, and the energy there.
    energy: Vec<[f64; 2]>,
    by_areas: bool,
    extremes: Option<[usize; 2]>,
    /// Why the crossings cannot be counted.
    uncounted: Option<&'static str>,
    /// The greatest and the least of the difference: where, how much, and how far the place may be off.
    steepest: Option<[(Amount, Amount, f64); 2]>,
}

#[derive(Clone, Copy)]
struct Crossing {
    at: Amount,
    node: usize,
    rises: bool,
    /// By how much it may lie elsewhere, besides what the tape knows.
    beside: f64,
}

impl Diagram {
    fn sheet(&self, cycle: &Cycle, tape: &mut Tape) -> CycleSheet {
        let period = cycle.period.value;
        // What its bound cannot tell from zero is zero: the level at the end of a period is its beginning.
        let marks: Vec<u32> = self.areas.iter().chain(&self.levels).map(|amount| amount.mark()).collect();
        let mut judged = tape.judged(&marks).into_iter();
        let mut told = |amounts: &[Amount]| -> Vec<f64> {
            let mut clear = |amount: &Amount| judged.next().is_some_and(|of| amount.value().abs() > of.bound);
            amounts.iter().map(|amount| if clear(amount) { amount.value() } else { 0.0 }).collect()
        };
        let (areas, levels) = (told(&self.areas), told(&self.levels));
        let mut curves = [Vec::new(), Vec::new()];
        for node in &self.nodes {
            for (side, curve) in curves.iter_mut().enumerate() {
                let at = node.at.value();
                for height in [node.before[side].value(), node.after[side].value()] {
                    if curve.last() != Some(&[at, height]) {
                        curve.push([at, height]);
                    }
                }
            }
        }
        // What has been turned is less of the period for an angle that falls.
        let placed = |turned: f64| if cycle.falling && turned > 0.0 { period - turned } else { turned };
        let whole = |turned: f64| if cycle.falling { period - turned } else { turned };
        if cycle.falling {
            for curve in &mut curves {
                curve.reverse();
                curve.iter_mut().for_each(|[at, _]| *at = period - *at);
            }
        }
        let crossings = self.crossings.iter().map(|crossing| {
            let node = &self.nodes[crossing.node];
            CycleCrossing {
                at: placed(crossing.at.value()),
                torque: node.after[1].value(),
                rises: crossing.rises,
            }
        });
        CycleSheet {
            period,
            curves,
            constant: self.constant,
            falling: cycle.falling,
            crossings: crossings.collect(),
            areas,
            levels,
            energy: self.energy.iter().map(|[turned, level]| [whole(*turned), *level]).collect(),
            extremes: self.extremes,
            numbers: Vec::new(),
        }
    }
}

struct Desk<'a> {
    board: Board,
    cycle: &'a Cycle,
    of: Option<OwnTorque<'a>>,
    /// How much area the parabolas may miss.
    missed: f64,
    /// The largest torque.
    largest: f64,
}

impl Desk<'_> {
    fn exact(&mut self, value: f64) -> Amount {
        self.board.amount(Given::exact(value))
    }

    /// Half of a number, or a sixth.
    fn over(&mut self, amount: Amount, by: f64) -> Amount {
        let by = self.exact(by);
        self.board.quotient(amount, by, REASON)
    }

    fn turning_sense(&self) -> f64 {
        if self.cycle.omega.value < 0.0 { -1.0 } else { 1.0 }
    }

    fn course(&mut self, course: &Course, sign: f64) -> Drawn {
        match course {
            // What drives is positive, whichever way the input turns.
            Course::Of(_) => {
                let knots = self.of.map_or(&[][..], |of| of.knots);
                let knots = knots.iter().map(|[at, period]| Breaks {
                    at: self.board.amount(*at),
                    period: self.board.amount(*period),
                    place: at.value,
                    turn: period.value,
                });
                Drawn::Of { knots: knots.collect(), sign: sign * self.turning_sense() }
            }
            Course::Curve(curve) => Drawn::Curve(Curved::new(&mut self.board, curve)),
        }
    }

    /// An angle with the copy's shift taken off.
    fn shifted(&mut self, angle: Angle, copy: u32) -> Angle {
        if copy == 0 {
            return angle;
        }
        let shift = self.board.amount(self.cycle.copies.shift);
        let by = self.exact(f64::from(copy));
        let by = self.board.product(by, shift);
        let at = self.board.difference(angle.at, by);
        Angle { at, place: angle.place - f64::from(copy) * self.cycle.copies.shift.value }
    }

    /// The angle of the input where this has been turned since angle 0, and the side from which one comes to it.
    fn of_input(&mut self, turned: Angle, limit: Limit) -> (Angle, Limit) {
        if !self.cycle.falling {
            return (turned, limit);
        }
        let zero = self.exact(0.0);
        let at = self.board.difference(zero, turned.at);
        let limit = if limit == Limit::Before { Limit::After } else { Limit::Before };
        (Angle { at, place: -turned.place }, limit)
    }

    /// The height of a curve where so much has been turned since angle 0, all copies together.
    fn height(&mut self, course: &Drawn, at: Angle, limit: Limit) -> Result<Amount, String> {
        let mut sum: Option<Amount> = None;
        for copy in 0..self.cycle.copies.number {
            let angle = self.shifted(at, copy);
            let (angle, limit) = self.of_input(angle, limit);
            let height = match course {
                Drawn::Curve(curve) => {
                    let turn = match curve {
                        Curved::Table(table) => table.turn,
                        Curved::Harmonics { .. } => 0.0,
                    };
                    let room = SAME * self.cycle.period.value.max(turn);
                    curve.height(&mut self.board, (angle.at, angle.place), (limit, room), REASON)
                }
                Drawn::Of { sign, knots } => {
                    let place = beside(knots, angle.place, limit);
                    let found = self.of.and_then(|of| (of.at)(place));
                    let (value, error) = found.ok_or_else(|| {
                        format!(
                            "the mechanism's torque is not determined at {:.6} deg of its input",
                            angle.place.to_degrees()
                        )
                    })?;
                    self.board.amount(Given::within(sign * value, error))
                }
            };
            sum = Some(match sum {
                Some(sum) => self.board.sum(sum, height),
                None => height,
            });
        }
        sum.ok_or_else(|| "there is no curve".to_owned())
    }

    /// Both curves of the diagram; none for one that is the mean of the other.
    fn courses(&mut self) -> [Option<Drawn>; 2] {
        let cycle = self.cycle;
        match &cycle.sides {
            Sides::Torque(torque) => [Some(self.course(torque, -1.0)), None],
            Sides::Load(load) => [None, Some(self.course(load, 1.0))],
            Sides::Both { torque, load } => [Some(self.course(torque, -1.0)), Some(self.course(load, 1.0))],
            Sides::Areas { .. } => [None, None],
        }
    }

    /// The heights of both curves; zero stands for one that is not known yet.
    fn heights(
        &mut self,
        courses: &[Option<Drawn>; 2],
        at: Angle,
        limit: Limit,
    ) -> Result<[Amount; 2], String> {
        let mut heights = [self.exact(0.0); 2];
        for (height, course) in heights.iter_mut().zip(courses) {
            if let Some(course) = course {
                *height = self.height(course, at, limit)?;
            }
        }
        Ok(heights)
    }

    /// Where a table bends, in the order of the motion, and both ends of the period.
    fn breaks(&mut self, courses: &[Option<Drawn>; 2]) -> Vec<Angle> {
        let period = self.cycle.period.value;
        let room = SAME * period;
        let (zero, whole) = (self.exact(0.0), self.board.amount(self.cycle.period));
        let mut breaks = vec![Angle { at: zero, place: 0.0 }, Angle { at: whole, place: period }];
        for course in courses.iter().flatten() {
            let knots = knots_of(course);
            for copy in 0..self.cycle.copies.number {
                for knot in &knots {
                    let again = libm::ceil(period / knot.turn) as i32;
                    let shift = self.board.amount(self.cycle.copies.shift);
                    let by = self.exact(f64::from(copy));
                    let by = self.board.product(by, shift);
                    let (knot_at, _) = self.of_input(Angle { at: knot.at, place: knot.place }, Limit::After);
                    let angle = self.board.sum(knot_at.at, by);
                    let seen = knot_at.place + f64::from(copy) * self.cycle.copies.shift.value;
                    let down = libm::floor((seen + room) / knot.turn);
                    for nth in 0..again {
                        let turns = f64::from(nth) - down;
                        let at = if turns == 0.0 {
                            angle
                        } else {
                            let by = self.exact(turns);
                            let by = self.board.product(by, knot.period);
                            self.board.sum(angle, by)
                        };
                        let place = seen + turns * knot.turn;
                        let taken = |known: &Angle| (known.place - place).abs() <= room;
                        if place > 0.0 && place < period && !breaks.iter().any(taken) {
                            breaks.push(Angle { at, place });
                        }
                    }
                }
            }
        }
        breaks.sort_by(|a, b| a.place.total_cmp(&b.place));
        breaks
    }

    /// A desk of scratch paper, to look before anything is drawn.
    fn scratch(&self) -> Desk<'_> {
        Desk { board: Board::scratch(), cycle: self.cycle, of: self.of, missed: 0.0, largest: self.largest }
    }

    /// The heights of both curves without a record.
    fn look(&self, at: f64) -> Result<[f64; 2], String> {
        self.look_from(at, Limit::After)
    }

    fn look_from(&self, place: f64, limit: Limit) -> Result<[f64; 2], String> {
        let mut scratch = self.scratch();
        let courses = scratch.courses();
        let at = scratch.exact(place);
        Ok(scratch.heights(&courses, Angle { at, place }, limit)?.map(|height| height.value()))
    }

    /// The difference of the curves on scratch paper; `mean` is the side that has none of its own.
    fn look_net(&self, at: f64, mean: Option<(usize, f64)>) -> Result<f64, String> {
        let mut heights = self.look(at)?;
        if let Some((side, mean)) = mean {
            heights[side] = mean;
        }
        Ok(heights[0] - heights[1])
    }

    /// An angle at which pieces meet.
    fn node(&mut self, courses: &[Option<Drawn>; 2], angle: Angle, leaps: bool) -> Result<Node, String> {
        let Angle { at, place } = angle;
        let after = self.heights(courses, angle, Limit::After)?;
        let seen_after = self.look_from(place, Limit::After)?;
        let (before, seen_before) = if leaps {
            (self.heights(courses, angle, Limit::Before)?, self.look_from(place, Limit::Before)?)
        } else {
            (after, seen_after)
        };
        let zero = ZERO * self.largest + self.noise_at(place);
        Ok(Node { at, before, after, place, seen: [seen_before, seen_after], zero })
    }

    /// Divides a piece until parabolas through three heights miss little: the angles of its parts, without its ends.
    fn divide(
        &mut self,
        ends: [(f64, [f64; 2]); 2],
        middle: [f64; 2],
        depth: u32,
        into: &mut Vec<f64>,
    ) -> Result<(), String> {
        let [(a, from), (b, to)] = ends;
        let (width, half) = (b - a, f64::midpoint(a, b));
        let quarters = [f64::midpoint(a, half), f64::midpoint(half, b)];
        let [left, right] = [self.look(quarters[0])?, self.look(quarters[1])?];
        let simpson = |a: f64, m: f64, b: f64, width: f64| (a + 4.0 * m + b) / 6.0 * width;
        let off = [0, 1].map(|side| {
            let once = simpson(from[side], middle[side], to[side], width);
            let twice = simpson(from[side], left[side], middle[side], width / 2.0)
                + simpson(middle[side], right[side], to[side], width / 2.0);
            (once - twice).abs()
        });
        let off = off[0].max(off[1]);
        let period = self.cycle.period.value;
        if off <= self.largest * (MISS * width).max(CORNER * period) || depth == 0 {
            self.missed += off;
            into.push(half);
            return Ok(());
        }
        self.divide([(a, from), (half, middle)], left, depth - 1, into)?;
        into.push(half);
        self.divide([(half, middle), (b, to)], right, depth - 1, into)
    }

    fn by_curves(&mut self) -> Result<Diagram, String> {
        let courses = self.courses();
        let breaks = self.breaks(&courses);
        let period = self.cycle.period.value;
        let curved = courses.iter().flatten().any(|course| !matches!(course, Drawn::Curve(Curved::Table(_))));
        // How large torques are.
        let looks = (0..=PIECES).map(|i| f64::from(i) / f64::from(PIECES) * period);
        for at in breaks.iter().map(|angle| angle.place).chain(looks) {
            self.largest =
                self.look(at)?.into_iter().fold(self.largest, |most, height| most.max(height.abs()));
        }
        if self.largest == 0.0 {
            return Err("the torque is zero throughout".to_owned());
        }
        let mut nodes = Vec::new();
        let mut pieces: Vec<Piece> = Vec::new();
        for (index, at) in breaks.iter().enumerate() {
            if let (true, Some(before)) = (curved, index.checked_sub(1).map(|i| breaks[i])) {
                let (from, to) = (before.place, at.place);
                let parts = libm::ceil((to - from) / period * f64::from(PIECES)).max(1.0);
                let mut inside = Vec::new();
                for part in 0..parts as u32 {
                    let [a, b] = [part, part + 1].map(|k| from + (to - from) * f64::from(k) / parts);
                    if part > 0 {
                        inside.push(a);
                    }
                    // Just inside, where a table may leap at the end.
                    let nudge = (b - a) * 1e-12;
                    let ends = [(a, self.look(a)?), (b, self.look(b - nudge)?)];
                    let middle = self.look(f64::midpoint(a, b))?;
                    self.divide(ends, middle, HALVINGS, &mut inside)?;
                }
                for place in inside {
                    let at = self.exact(place);
                    nodes.push(self.node(&courses, Angle { at, place }, false)?);
                }
            }
            nodes.push(self.node(&courses, *at, true)?);
        }
        for ends in nodes.windows(2) {
            pieces.push(if curved {
                let place = f64::midpoint(ends[0].place, ends[1].place);
                let at = self.exact(place);
                Some(self.heights(&courses, Angle { at, place }, Limit::After)?)
            } else {
                None
            });
        }
        let (mean, work, constant) = self.mean(&courses, &mut nodes, &mut pieces)?;
        let level = match constant {
            Some(side) => Some(Level { side, mean, seen: self.seen_mean(1 - side, &nodes, curved)? }),
            None => None,
        };
        if let Some(Level { side, seen, .. }) = level {
            for node in &mut nodes {
                node.seen[0][side] = seen;
                node.seen[1][side] = seen;
            }
        }
        if curved {
            self.dips(&courses, level, &mut nodes, &mut pieces)?;
        }
        let crossings = self.crossings(&courses, level, &mut nodes, &mut pieces)?;
        let uncounted = self.uncounted(&crossings, &nodes);
        self.balance(Parts { nodes, pieces, mean, work, constant, crossings, uncounted, courses: &courses })
    }

    /// The mean of a curve on scratch paper.
    fn seen_mean(&self, side: usize, nodes: &[Node], curved: bool) -> Result<f64, String> {
        let mut sum = 0.0;
        for ends in nodes.windows(2) {
            let width = ends[1].place - ends[0].place;
            let both = ends[0].seen[1][side] + ends[1].seen[0][side];
            sum += if curved {
                let middle = self.look(f64::midpoint(ends[0].place, ends[1].place))?[side];
                (both + 4.0 * middle) / 6.0 * width
            } else {
                both / 2.0 * width
            };
        }
        Ok(sum / self.cycle.period.value)
    }

    /// Where between two nodes one curve dips through the other and comes back: a node there, so that both crossings
    /// are found.
    fn dips(
        &mut self,
        courses: &[Option<Drawn>; 2],
        level: Option<Level>,
        nodes: &mut Vec<Node>,
        pieces: &mut Vec<Piece>,
    ) -> Result<(), String> {
        let mut index = 0;
        while index + 1 < nodes.len() {
            let ends = [nodes[index], nodes[index + 1]];
            index += 1;
            // They may part from where they are one, and cross once more at once.
            let signs = [ends[0].sign(Limit::After), ends[1].sign(Limit::Before)];
            let sign = (signs[0] + signs[1]).clamp(-1.0, 1.0);
            if sign == 0.0 {
                continue;
            }
            let net = |at: f64| self.look_net(at, level.map(Level::seen)).map(|net| sign * net);
            let [from, to] = ends.map(|end| end.place);
            let looked = [
                sign * ends[0].net(Limit::After),
                net(f64::midpoint(from, to))?,
                sign * ends[1].net(Limit::Before),
            ];
            let (least, most) = (
                looked.iter().copied().fold(f64::INFINITY, f64::min),
                looked.iter().copied().fold(0.0, f64::max),
            );
            if least > 4.0 * (most - least) {
                continue;
            }
            // It dips only where it falls into the piece from both ends.
            let step = 1e-3 * (to - from);
            if net(from + step)? >= looked[0] || net(to - step)? >= looked[2] {
                continue;
            }
            let (mut low, mut high) = (from, to);
            for _ in 0..80 {
                let third = (high - low) / 3.0;
                if net(low + third)? < net(high - third)? { high -= third } else { low += third }
            }
            let place = f64::midpoint(low, high);
            if place > from && place < to && net(place)? < -ends[0].zero {
                let (node, halves) = self.split(courses, level, ends, place)?;
                nodes.insert(index, node);
                pieces.splice(index - 1..index, halves);
                index += 1;
            }
        }
        Ok(())
    }

    /// A node within a curved piece, and the halves of the piece.
    fn split(
        &mut self,
        courses: &[Option<Drawn>; 2],
        level: Option<Level>,
        ends: [Node; 2],
        place: f64,
    ) -> Result<(Node, [Piece; 2]), String> {
        let at = self.exact(place);
        let mut node = self.node(courses, Angle { at, place }, false)?;
        let mut halves = [None; 2];
        for (half, end) in halves.iter_mut().zip(ends) {
            let place = f64::midpoint(place, end.place);
            let at = self.exact(place);
            *half = Some(self.heights(courses, Angle { at, place }, Limit::After)?);
        }
        if let Some(Level { side, mean, seen }) = level {
            (node.before[side], node.after[side]) = (mean, mean);
            (node.seen[0][side], node.seen[1][side]) = (seen, seen);
            for half in halves.iter_mut().flatten() {
                half[side] = mean;
            }
        }
        Ok((node, halves))
    }

    /// Why crossings cannot be counted: near the beginning of the period it is not told which is the first, and curves
    /// that all but touch cross twice or not at all.
    fn uncounted(&self, crossings: &[Crossing], nodes: &[Node]) -> Option<&'static str> {
        let period = self.cycle.period.value;
        let near = BEGINNING * period;
        let at_beginning = |crossing: &Crossing| {
            let place = nodes[crossing.node].place;
            if crossing.node == 0 { crossing.beside > near } else { place <= near || place >= period - near }
        };
        if crossings.iter().any(at_beginning) {
            return Some(
                "the curves cross so near the beginning of the period that no crossing is surely the first",
            );
        }
        let touches = |index: usize| {
            let from = crossings[index].node;
            let to = crossings[(index + 1) % crossings.len()].node;
            let [one, two] = if to > from {
                [&nodes[from + 1..to], &nodes[..0]]
            } else {
                [&nodes[from + 1..], &nodes[..to]]
            };
            let parted = |node: &Node, limit: Limit| node.net(limit).abs() > TOUCH * node.zero;
            let between = one.iter().chain(two);
            !between.into_iter().any(|node| parted(node, Limit::Before) || parted(node, Limit::After))
                && !parted(&nodes[from], Limit::After)
                && !parted(&nodes[to], Limit::Before)
        };
        (0..crossings.len())
            .any(touches)
            .then_some("the curves all but touch, and whether they cross there is not told")
    }

    /// The area under one curve, piece by piece, or between both.
    fn area(
        &mut self,
        ends: [&Node; 2],
        middle: Piece,
        of: impl Fn(&mut Self, [Amount; 2]) -> Amount,
    ) -> Amount {
        let width = self.board.difference(ends[1].at, ends[0].at);
        let (from, to) = (of(self, ends[0].after), of(self, ends[1].before));
        let both = self.board.sum(from, to);
        match middle {
            None => {
                let area = self.board.product(both, width);
                self.over(area, 2.0)
            }
            Some(middle) => {
                let middle = of(self, middle);
                let four = self.exact(4.0);
                let middle = self.board.product(four, middle);
                let sum = self.board.sum(both, middle);
                let area = self.board.product(sum, width);
                self.over(area, 6.0)
            }
        }
    }

    /// The mean torque and the work of a period; a curve that is missing is drawn at the mean.
    fn mean(
        &mut self,
        courses: &[Option<Drawn>; 2],
        nodes: &mut [Node],
        pieces: &mut [Piece],
    ) -> Result<(Amount, Amount, Option<usize>), String> {
        let mut works = [None, None];
        for side in 0..2 {
            if courses[side].is_none() {
                continue;
            }
            let mut work = self.exact(0.0);
            for (ends, middle) in nodes.windows(2).zip(pieces.iter()) {
                let area = self.area([&ends[0], &ends[1]], *middle, |_, heights| heights[side]);
                work = self.board.sum(work, area);
            }
            works[side] = Some(work);
        }
        let work = works[0].or(works[1]).ok_or_else(|| "there is no curve".to_owned())?;
        let period = self.board.amount(self.cycle.period);
        let mean = self.board.quotient(work, period, REASON);
        if mean.value().abs() <= 1e-9 * self.largest {
            return Err("the mean torque is zero: no work is done in a period".to_owned());
        }
        if let [Some(torque), Some(load)] = works {
            let (torque, load) = (torque.value(), load.value());
            if (torque - load).abs() > ONE_MEAN * torque.abs().max(load.abs()) {
                let means = [torque, load].map(|work| work / self.cycle.period.value);
                let all = match self.cycle.copies.number {
                    1 => String::new(),
                    number => format!(" ({number} copies of each together)"),
                };
                return Err(format!(
                    "the two torques have different means, {:.6} N m and {:.6} N m{all}: the speed would not come back",
                    means[0], means[1]
                ));
            }
        }
        let constant = courses.iter().position(Option::is_none);
        if let Some(side) = constant {
            for node in nodes.iter_mut() {
                node.before[side] = mean;
                node.after[side] = mean;
            }
            for middle in pieces.iter_mut().flatten() {
                middle[side] = mean;
            }
        }
        Ok((mean, work, constant))
    }

    /// The difference of the two curves.
    fn net(&mut self, [torque, load]: [Amount; 2]) -> Amount {
        self.board.difference(torque, load)
    }

    /// Where the curves cross: a leap through counts, a touch does not. Each becomes a node.
    fn crossings(
        &mut self,
        courses: &[Option<Drawn>; 2],
        level: Option<Level>,
        nodes: &mut Vec<Node>,
        pieces: &mut Vec<Piece>,
    ) -> Result<Vec<Crossing>, String> {
        // As the period before ends: what comes after its last angle comes after angle 0 as well.
        let end = nodes.len() - 1;
        let reversed =
            nodes[1..end].iter().rev().flat_map(|node| [node.sign(Limit::After), node.sign(Limit::Before)]);
        let last = [nodes[end].sign(Limit::Before)];
        let ended =
            last.into_iter().chain(reversed).chain([nodes[0].sign(Limit::After)]).find(|sign| *sign != 0.0);
        let mut last = ended.ok_or("the two torques are one throughout: nothing fluctuates")?;
        let mut crossings: Vec<Crossing> = Vec::new();
        let mut touched: Option<usize> = None;
        let mut index = 0;
        while index + 1 < nodes.len() {
            // At the node itself: what comes before angle 0 is the end of the period.
            let node = nodes[index];
            let before = nodes[if index == 0 { nodes.len() - 1 } else { index }].sign(Limit::Before);
            if before == 0.0 && touched.is_none() {
                touched = Some(index);
            }
            let after = node.sign(Limit::After);
            if after == 0.0 && touched.is_none() {
                touched = Some(index);
            }
            if after != 0.0 {
                if after != last {
                    let beside = match touched {
                        Some(touched) => self.spread(level, nodes, touched, touched == index)?,
                        None => 0.0,
                    };
                    let node = touched.unwrap_or(index);
                    crossings.push(Crossing { at: nodes[node].at, node, rises: after > 0.0, beside });
                }
                last = after;
                touched = None;
            }
            // Within the piece that follows; curves that were one part again in it.
            let next = nodes[index + 1].sign(Limit::Before);
            if let (Some(touched), true) = (touched, next != 0.0) {
                if next != last {
                    let beside = self.spread(level, nodes, touched, touched == index)?;
                    crossings.push(Crossing {
                        at: nodes[touched].at,
                        node: touched,
                        rises: next > 0.0,
                        beside,
                    });
                }
                last = next;
            } else if next != 0.0 && next != last {
                let ends = [nodes[index], nodes[index + 1]];
                let (node, at, halves) = match pieces[index] {
                    Some(_) => self.meet(courses, level, ends)?,
                    None => {
                        let node = self.meet_of_lines(ends);
                        (node, (node.at, 0.0), [None, None])
                    }
                };
                nodes.insert(index + 1, node);
                pieces.splice(index..=index, halves);
                let (at, beside) = at;
                crossings.push(Crossing { at, node: index + 1, rises: next > 0.0, beside });
                last = next;
                index += 1;
            }
            if next != 0.0 {
                touched = None;
            }
            index += 1;
        }
        Ok(crossings)
    }

    /// How far from a node at which the curves are not told apart they may cross: so far it is to where they are, before
    /// it and, where they part at the node itself, after it.
    fn spread(&self, level: Option<Level>, nodes: &[Node], index: usize, both: bool) -> Result<f64, String> {
        let period = self.cycle.period.value;
        let node = nodes[index];
        let (place, last) = if index == 0 { (period, nodes.len() - 1) } else { (node.place, index) };
        let mut sides = vec![nodes[last - 1].place - place];
        if both {
            sides.push(nodes[index + 1].place - node.place);
        }
        // A leap through the node is a crossing at the node.
        if nodes[last].sign(Limit::Before) != 0.0 {
            sides.remove(0);
        }
        if node.sign(Limit::After) != 0.0 && both {
            sides.pop();
        }
        let mut most = 0.0_f64;
        for side in sides {
            let from = if side < 0.0 { place } else { node.place };
            let mut part = 1.0 / 1_099_511_627_776.0;
            while part < 1.0 {
                let net = self.look_net(from + part * side, level.map(Level::seen))?;
                if net.abs() > 4.0 * node.zero {
                    break;
                }
                part *= 2.0;
            }
            // Where they are one for as long as one sees, the place is that of the node.
            if part < 1.0 {
                most = most.max(part * side.abs());
            }
        }
        Ok(most)
    }

    /// Where the curves cross within a curved piece: a node there, its angle and by how much that may be off besides, and
    /// the two halves of the piece.
    fn meet(
        &mut self,
        courses: &[Option<Drawn>; 2],
        level: Option<Level>,
        ends: [Node; 2],
    ) -> Result<Met, String> {
        let net = |desk: &Self, at: f64| desk.look_net(at, level.map(Level::seen));
        let [a, b] = ends.map(|node| node.place);
        let [mut from, mut to] = [a, b];
        let rises = ends[1].net(Limit::Before) > 0.0;
        loop {
            let middle = f64::midpoint(from, to);
            if middle <= from || middle >= to {
                break;
            }
            if (net(self, middle)? > 0.0) == rises {
                to = middle;
            } else {
                from = middle;
            }
        }
        let slope = {
            let inside = b - (b - a) * 1e-12;
            let near = (1e-3 * (b - a)).min((from - a) / 4.0).min((b - from) / 4.0).max(1e-7 * (b - a));
            let (left, right) = ((from - near).max(a), (from + near).min(inside));
            let here = (net(self, right)? - net(self, left)?) / (right - left);
            if here == 0.0 || !here.is_finite() {
                (net(self, inside)? - net(self, a)?) / (b - a)
            } else {
                here
            }
        };
        let (node, halves) = self.split(courses, level, ends, from)?;
        let off = self.net(node.after);
        let beside = 64.0 * f64::EPSILON * self.largest / slope.abs();
        let slope = self.exact(slope);
        let step = self.board.quotient(off, slope, REASON);
        let at = self.board.difference(node.at, step);
        Ok((node, (at, beside), halves))
    }

    /// The meet of two straight pieces on the paper.
    fn meet_of_lines(&mut self, ends: [Node; 2]) -> Node {
        let power = |size: f64| Scale { si_per_mm: libm::exp2(libm::ceil(libm::log2(size / 100.0))) };
        let (angles, torques) = (power(self.cycle.period.value), power(self.largest));
        let mut lines = Vec::new();
        let origin = self.board.origin();
        for side in 0..2 {
            let place = |desk: &mut Self, at: Amount, height: Amount| -> Point {
                let (x, y): (Mm, Mm) =
                    (desk.board.to_paper(at, angles), desk.board.to_paper(height, torques));
                desk.board.prick(x, y)
            };
            let from = place(self, ends[0].at, ends[0].after[side]);
            let to = place(self, ends[1].at, ends[1].before[side]);
            let (along, _) = self.board.toward(from, to, REASON);
            lines.push(Line { through: from, along });
        }
        let meet = self.board.meet_lines(lines[0], lines[1], REASON);
        let [x, y] = self.board.between(origin, meet.at);
        let (at, height) = (self.board.read(x, angles), self.board.read(y, torques));
        let [from, to] = [ends[0].net(Limit::After), ends[1].net(Limit::Before)];
        let place = ends[0].place + (ends[1].place - ends[0].place) * from / (from - to);
        let seen = [[height.value(); 2]; 2];
        Node { at, before: [height; 2], after: [height; 2], place, seen, zero: ends[0].zero }
    }

    /// Areas, levels and the steepest places.
    fn balance(&mut self, parts: Parts<'_>) -> Result<Diagram, String> {
        let Parts { nodes, pieces, mean, work, constant, crossings, uncounted, courses } = parts;
        let mut level = self.exact(0.0);
        let mut levels_at = vec![level];
        for (ends, middle) in nodes.windows(2).zip(&pieces) {
            let area = self.area([&ends[0], &ends[1]], *middle, |desk, heights| desk.net(heights));
            level = self.board.sum(level, area);
            levels_at.push(level);
        }
        let levels: Vec<Amount> = crossings.iter().map(|crossing| levels_at[crossing.node]).collect();
        let mut areas = Vec::new();
        for (index, from) in levels.iter().enumerate() {
            areas.push(match levels.get(index + 1) {
                Some(to) => self.board.difference(*to, *from),
                None => {
                    // On to the first crossing of the next period.
                    let rest = self.board.difference(level, *from);
                    self.board.sum(rest, levels[0])
                }
            });
        }
        let extremes = self.extremes(&levels);
        let places: Vec<usize> = crossings.iter().map(|crossing| crossing.node).collect();
        let energy = self.energy((&nodes, &pieces), &levels_at, &places);
        let steepest = self.steepest(courses, constant, mean, &nodes, &pieces)?;
        Ok(Diagram {
            nodes,
            mean: Some((mean, work)),
            constant,
            crossings,
            areas,
            levels,
            energy,
            by_areas: false,
            extremes,
            uncounted,
            steepest: Some(steepest),
        })
    }

    /// The energy over what has been turned, as closely as it is drawn, and at the crossings: what the areas of the pieces
    /// come to, and within each the area of its line or parabola so far.
    fn energy(
        &self,
        (nodes, pieces): (&[Node], &[Piece]),
        levels: &[Amount],
        crossings: &[usize],
    ) -> Vec<[f64; 2]> {
        let whole = self.cycle.period.value;
        let step = whole / f64::from(DRAWN);
        let net = |[torque, load]: [Amount; 2]| torque.value() - load.value();
        let mut all: Vec<[f64; 2]> = Vec::new();
        for (index, (ends, middle)) in nodes.windows(2).zip(pieces).enumerate() {
            let [from, to] = [ends[0].at.value(), ends[1].at.value()];
            let (width, start) = (to - from, levels[index].value());
            if all.last().is_none_or(|[at, _]| from - at >= step) || crossings.contains(&index) {
                all.push([from, start]);
            }
            let [first, last] = [net(ends[0].after), net(ends[1].before)];
            let middle = middle.map_or(f64::midpoint(first, last), net);
            let (slope, bend) = (4.0 * middle - 3.0 * first - last, 2.0 * (first + last) - 4.0 * middle);
            let parts = libm::floor(width / step) as u32;
            for part in 1..parts {
                let t = f64::from(part) / f64::from(parts);
                let area = width * t * (first + t * (slope / 2.0 + t * bend / 3.0));
                all.push([from + t * width, start + area]);
            }
        }
        all.extend(nodes.last().zip(levels.last()).map(|(node, level)| [node.at.value(), level.value()]));
        all
    }

    /// The highest and the lowest level; of equal ones the first.
    fn extremes(&self, levels: &[Amount]) -> Option<[usize; 2]> {
        let values: Vec<f64> = levels.iter().map(Amount::value).collect();
        let most = values.iter().copied().reduce(f64::max)?;
        let least = values.iter().copied().reduce(f64::min)?;
        let room = 1e-9 * (most - least);
        let highest = values.iter().position(|level| *level >= most - room)?;
        let lowest = values.iter().position(|level| *level <= least + room)?;
        Some([highest, lowest])
    }

    /// Where the difference is greatest and least, with what it is there.
    fn steepest(
        &mut self,
        courses: &[Option<Drawn>; 2],
        constant: Option<usize>,
        mean: Amount,
        nodes: &[Node],
        pieces: &[Piece],
    ) -> Result<[(Amount, Amount, f64); 2], String> {
        let mut found = Vec::new();
        for up in [1.0, -1.0] {
            let net = |heights: [Amount; 2]| up * (heights[0].value() - heights[1].value());
            let at_node = |node: &Node| net(node.before).max(net(node.after));
            let most = nodes.iter().map(at_node).fold(f64::NEG_INFINITY, f64::max);
            let room = 1e-9 * self.largest;
            // Two tops of one height are seen at nodes of different ones: whichever may rise to the highest is followed.
            let is_curved = pieces.iter().any(Option::is_some);
            let seen = |index: Option<usize>| index.and_then(|index| nodes.get(index)).map(at_node);
            let mut tops = Vec::new();
            for (index, node) in nodes.iter().enumerate() {
                let own = at_node(node);
                let [before, after] =
                    [index.checked_sub(1), Some(index + 1)].map(|beside| seen(beside).unwrap_or(own));
                let rise = (own - before) + (own - after);
                let may_rise = is_curved && own >= before.max(after) && rise > room;
                if own < most - if may_rise { rise.max(room) } else { room } {
                    continue;
                }
                let top = if is_curved { self.top_beside(nodes, index, (up, constant, mean))? } else { None };
                tops.push((index, top));
            }
            let height =
                |(index, top): &(usize, Option<Top>)| top.map_or(at_node(&nodes[*index]), |top| top.height);
            let most = tops.iter().map(height).fold(f64::NEG_INFINITY, f64::max);
            let mut first = tops.iter().filter(|top| height(top) >= most - room);
            let &(index, top) = first.next().ok_or_else(|| "there is no curve".to_owned())?;
            let node = nodes[index];
            let heights = if net(node.after) >= net(node.before) { node.after } else { node.before };
            let mut place = (node.at, heights, 0.0);
            if let Some(Top { at, room, .. }) = top {
                let leaf = self.exact(at);
                let mut heights = self.heights(courses, Angle { at: leaf, place: at }, Limit::After)?;
                if let Some(side) = constant {
                    heights[side] = mean;
                }
                place = (leaf, heights, room + at.abs() * f64::EPSILON);
            }
            let (at, heights, room) = place;
            found.push((at, self.net(heights), room));
        }
        match found[..] {
            [most, least] => Ok([most, least]),
            _ => Err("there is no curve".to_owned()),
        }
    }

    /// The top of a curve between the neighbours of a node, where that stands higher than the node.
    fn top_beside(
        &self,
        nodes: &[Node],
        index: usize,
        (up, constant, mean): (f64, Option<usize>, Amount),
    ) -> Result<Option<Top>, String> {
        let look = |at: f64| -> Result<f64, String> {
            let mut heights = self.look(at)?;
            if let Some(side) = constant {
                heights[side] = mean.value();
            }
            Ok(up * (heights[0] - heights[1]))
        };
        let node = nodes[index];
        let net = |heights: [Amount; 2]| up * (heights[0].value() - heights[1].value());
        let neighbour = |index: usize| nodes.get(index).map(|node| node.at.value());
        let from = index.checked_sub(1).and_then(neighbour).unwrap_or(node.at.value());
        let to = neighbour(index + 1).unwrap_or(node.at.value());
        let (mut low, mut high) = (from, to);
        for _ in 0..60 {
            let third = (high - low) / 3.0;
            let (a, b) = (low + third, high - third);
            if look(a)? < look(b)? {
                low = a;
            } else {
                high = b;
            }
        }
        let at = f64::midpoint(low, high);
        let height = look(at)?;
        if height <= net(node.before).max(net(node.after)) {
            return Ok(None);
        }
        // Within this of the top nothing tells where it is.
        let step = (to - from) / 4.0;
        let bend = (look(at - step)? - 2.0 * height + look(at + step)?) / (step * step);
        let noise = 64.0 * f64::EPSILON * self.largest + self.noise_at(at);
        let room = if bend < 0.0 { 2.0 * libm::sqrt(2.0 * noise / -bend) } else { to - from };
        Ok(Some(Top { at, height, room }))
    }

    /// How far the mechanism's torque may be off.
    fn noise_at(&self, at: f64) -> f64 {
        let at = if self.cycle.falling { -at } else { at };
        match self.of.and_then(|of| (of.at)(at)) {
            Some((_, error)) => error,
            // A curve that is given has no other noise than its rounding.
            None => 0.0,
        }
    }

    fn by_areas(
        &mut self,
        areas: &[Given],
        torque: Given,
        angle: Given,
        total: Option<Given>,
    ) -> Result<Diagram, String> {
        let [torque, angle] = [torque, angle].map(|given| self.board.amount(given));
        let unit = self.board.product(torque, angle);
        let mean = total.map(|total| {
            let total = self.board.amount(total);
            let work = self.board.product(total, unit);
            let period = self.board.amount(self.cycle.period);
            (self.board.quotient(work, period, REASON), work)
        });
        let (sum, all) =
            areas.iter().fold((0.0, 0.0), |(sum, all), area| (sum + area.value, all + area.value.abs()));
        if f64::abs(sum) > ONE_MEAN * all {
            return Err(format!(
                "the areas above and below the mean differ by {sum:.6}: the speed would not come back"
            ));
        }
        if total.is_some_and(|total| total.value == 0.0) {
            return Err("the mean torque is zero: no work is done in a period".to_owned());
        }
        let mut level = self.exact(0.0);
        let (mut drawn, mut levels) = (Vec::new(), Vec::new());
        for area in areas {
            let area = self.board.amount(*area);
            let area = self.board.product(area, unit);
            level = self.board.sum(level, area);
            drawn.push(area);
            levels.push(level);
        }
        let extremes = self.extremes(&levels);
        Ok(Diagram {
            nodes: Vec::new(),
            mean,
            constant: Some(1),
            crossings: Vec::new(),
            areas: drawn,
            levels,
            energy: Vec::new(),
            by_areas: true,
            extremes,
            uncounted: None,
            steepest: None,
        })
    }

    /// What turns with the input, referred to it: Σ I (ratio)².
    fn rotating(&mut self, g: Given) -> Option<Amount> {
        let mut sum: Option<Amount> = None;
        for rotating in &self.cycle.rotating {
            let central = match rotating.inertia {
                RotatingInertia::Central(inertia) => self.board.amount(inertia),
                RotatingInertia::Mass(mass, radius) | RotatingInertia::Weight(mass, radius) => {
                    let (mut mass, radius) = (self.board.amount(mass), self.board.amount(radius));
                    if matches!(rotating.inertia, RotatingInertia::Weight(..)) {
                        let g = self.board.amount(g);
                        mass = self.board.quotient(mass, g, REASON);
                    }
                    let square = self.board.product(radius, radius);
                    self.board.product(mass, square)
                }
            };
            let ratio = self.board.amount(rotating.ratio);
            let square = self.board.product(ratio, ratio);
            let referred = self.board.product(central, square);
            sum = Some(match sum {
                Some(sum) => self.board.sum(sum, referred),
                None => referred,
            });
        }
        sum
    }

    fn fluctuation(&mut self, drawn: &Diagram) -> Result<Amount, String> {
        let [highest, lowest] = drawn.extremes.ok_or("the curves do not cross")?;
        Ok(self.board.difference(drawn.levels[highest], drawn.levels[lowest]))
    }

    /// ω² of the mean speed.
    fn speed_squared(&mut self) -> Result<Amount, String> {
        if self.cycle.omega.value == 0.0 {
            return Err("the input rests: give its `omega`".to_owned());
        }
        let omega = self.board.amount(self.cycle.omega);
        Ok(self.board.product(omega, omega))
    }

    /// The inertia that would hold the speed within the wanted fluctuation.
    fn needed(&mut self, drawn: &Diagram, wanted: Given) -> Result<Amount, String> {
        let fluctuation = self.fluctuation(drawn)?;
        let square = self.speed_squared()?;
        let wanted = self.board.amount(wanted);
        let by = self.board.product(wanted, square);
        Ok(self.board.quotient(fluctuation, by, REASON))
    }

    /// Whether what turns is heavier than the wanted fluctuation needs: no flywheel is added, and the speed changes less.
    fn turns_heavily_enough(&mut self, drawn: &Diagram, (wanted, g): (Given, Given)) -> bool {
        let Some(there) = self.rotating(g) else { return false };
        self.needed(drawn, wanted).is_ok_and(|needed| there.value() > needed.value())
    }

    /// All that turns, with the flywheel where one is sought.
    fn turning(&mut self, drawn: &Diagram, g: Given) -> Result<Amount, String> {
        let rotating = self.rotating(g);
        match (self.cycle.fluctuation, rotating) {
            (Some(wanted), rotating) => {
                let needed = self.needed(drawn, wanted)?;
                Ok(match rotating {
                    // A flywheel that is not needed is not there.
                    Some(there) if there.value() > needed.value() => there,
                    _ => needed,
                })
            }
            (None, Some(rotating)) => Ok(rotating),
            (None, None) => Err("nothing is said of what turns: give `rotating`".to_owned()),
        }
    }

    fn read(&mut self, drawn: &Diagram, g: Given, of: CycleQuantity) -> Result<Number, String> {
        let plain = |amount: Amount| Ok(Number { amount, beside: 0.0 });
        let missed = self.missed;
        // What the parabolas miss goes on in proportion.
        let with_area =
            |amount: Amount, per_area: f64| Ok(Number { amount, beside: missed * per_area.abs() });
        let numbered = |k: u32, of: &[Amount], what: &str| -> Result<Amount, String> {
            let index = (k as usize).checked_sub(1);
            index
                .and_then(|index| of.get(index))
                .copied()
                .ok_or_else(|| format!("there are {} {what}", of.len()))
        };
        let of_mean = || drawn.mean.ok_or("areas alone do not tell the mean: give `total`");
        let unplaced = || "areas alone do not say at which angle".to_owned();
        if let Some(why) = drawn.uncounted.filter(|_| of.counts_crossings()) {
            return Err(why.to_owned());
        }
        match of {
            CycleQuantity::Mean => with_area(of_mean()?.0, 1.0 / self.cycle.period.value),
            CycleQuantity::Work => with_area(of_mean()?.1, 1.0),
            CycleQuantity::Power => {
                self.speed_squared()?;
                let omega = self.board.amount(self.cycle.omega);
                let omega = self.board.magnitude(omega);
                let power = self.board.product(of_mean()?.0, omega);
                with_area(power, omega.value() / self.cycle.period.value)
            }
            CycleQuantity::Highest | CycleQuantity::Lowest => {
                let [highest, lowest] = drawn.extremes.ok_or("the curves do not cross")?;
                let index = if of == CycleQuantity::Highest { highest } else { lowest };
                with_area(drawn.levels[index], 2.0)
            }
            CycleQuantity::Fluctuation => with_area(self.fluctuation(drawn)?, 2.0),
            CycleQuantity::OfEnergy => {
                let fluctuation = self.fluctuation(drawn)?;
                let work = self.board.magnitude(of_mean()?.1);
                let part = self.board.quotient(fluctuation, work, REASON);
                with_area(part, (2.0 + part.value()) / work.value())
            }
            CycleQuantity::OfSpeed => {
                if let Some(wanted) = self.cycle.fluctuation
                    && !self.turns_heavily_enough(drawn, (wanted, g))
                {
                    return plain(self.board.amount(wanted));
                }
                let turning = self.turning(drawn, g)?;
                let square = self.speed_squared()?;
                let by = self.board.product(turning, square);
                let fluctuation = self.fluctuation(drawn)?;
                let part = self.board.quotient(fluctuation, by, REASON);
                if part.value() >= 2.0 {
                    return Err("what turns is too light: the least speed would be below zero".to_owned());
                }
                with_area(part, 2.0 / by.value())
            }
            CycleQuantity::Flywheel => {
                let wanted = self.cycle.fluctuation.ok_or("no `fluctuation` is wanted")?;
                let needed = self.needed(drawn, wanted)?;
                let still = match self.rotating(g) {
                    Some(there) => self.board.difference(needed, there),
                    None => needed,
                };
                if still.value() < 0.0 {
                    return Err("no flywheel is needed: what turns is heavy enough".to_owned());
                }
                let omega = self.cycle.omega.value;
                with_area(still, 2.0 / (wanted.value * omega * omega))
            }
            CycleQuantity::Inertia => {
                plain(self.rotating(g).ok_or("nothing is said of what turns: give `rotating`")?)
            }
            CycleQuantity::Crossing(_) | CycleQuantity::AtHighest | CycleQuantity::AtLowest
                if drawn.by_areas =>
            {
                Err(unplaced())
            }
            CycleQuantity::Crossing(k) => {
                let angles: Vec<Amount> = drawn.crossings.iter().map(|crossing| crossing.at).collect();
                let at = numbered(k, &angles, "crossings")?;
                let beside = drawn.crossings[k as usize - 1].beside + self.shifted_by_mean(drawn, k);
                Ok(Number { amount: self.angle_told(at), beside })
            }
            CycleQuantity::Area(k) => with_area(numbered(k, &drawn.areas, "areas")?, 2.0),
            CycleQuantity::Level(k) => with_area(numbered(k, &drawn.levels, "levels")?, 2.0),
            CycleQuantity::AtHighest | CycleQuantity::AtLowest => {
                let [highest, lowest] = drawn.extremes.ok_or("the curves do not cross")?;
                let index = if of == CycleQuantity::AtHighest { highest } else { lowest };
                let crossing = drawn.crossings[index];
                let beside = crossing.beside + self.shifted_by_mean(drawn, index as u32 + 1);
                Ok(Number { amount: self.angle_told(crossing.at), beside })
            }
            CycleQuantity::Most | CycleQuantity::Least | CycleQuantity::AtMost | CycleQuantity::AtLeast => {
                let [most, least] = drawn.steepest.ok_or_else(unplaced)?;
                let (at, net, room) = match of {
                    CycleQuantity::Most | CycleQuantity::AtMost => most,
                    _ => least,
                };
                if matches!(of, CycleQuantity::AtMost | CycleQuantity::AtLeast) {
                    return Ok(Number { amount: self.angle_told(at), beside: room });
                }
                let turning = self.turning(drawn, g)?;
                let alpha = self.board.quotient(net, turning, REASON);
                let of_mean = 1.0 / self.cycle.period.value;
                let of_flywheel = match self.cycle.fluctuation {
                    Some(wanted) => {
                        let omega = self.cycle.omega.value;
                        2.0 * alpha.value() / (wanted.value * omega * omega)
                    }
                    None => 0.0,
                };
                with_area(alpha, (of_mean + of_flywheel.abs()) / turning.value())
            }
        }
    }

    /// The angle of the input, within a period from 0, where so much has been turned.
    fn angle_told(&mut self, turned: Amount) -> Amount {
        if !self.cycle.falling || turned.value() == 0.0 {
            return turned;
        }
        let period = self.board.amount(self.cycle.period);
        self.board.difference(period, turned)
    }

    /// By how much a crossing lies elsewhere where parabolas miss the mean.
    fn shifted_by_mean(&self, drawn: &Diagram, k: u32) -> f64 {
        if self.missed == 0.0 || drawn.constant.is_none() {
            return 0.0;
        }
        let Some(crossing) = (k as usize).checked_sub(1).and_then(|index| drawn.crossings.get(index)) else {
            return 0.0;
        };
        let at = crossing.at.value();
        let step = 1e-4 * self.cycle.period.value;
        let known = usize::from(drawn.constant == Some(0));
        match (self.look(at - step), self.look(at + step)) {
            (Ok(before), Ok(after)) => {
                let slope = (after[known] - before[known]).abs() / (2.0 * step);
                2.0 * self.missed / self.cycle.period.value / slope.max(f64::MIN_POSITIVE)
            }
            _ => f64::INFINITY,
        }
    }
}

/// What the areas are taken from.
struct Parts<'a> {
    nodes: Vec<Node>,
    pieces: Vec<Piece>,
    mean: Amount,
    work: Amount,
    constant: Option<usize>,
    crossings: Vec<Crossing>,
    uncounted: Option<&'static str>,
    courses: &'a [Option<Drawn>; 2],
}
