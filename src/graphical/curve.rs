//! The height of a curve over the angle of the input: read between two knots of its table, or of turning arrows.

use crate::board::{Amount, Board, Reason};
use crate::mechanism::curve::Curve;

/// From which side one comes to an angle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Limit {
    Before,
    After,
}

/// Nearer than this part of the period to a knot one stands on it.
const ON_KNOT: f64 = 8.0 * f64::EPSILON;

/// A table on the board. Where the knots stand, and after which angle they come again, is besides what decides which are
/// used.
pub(super) struct Table {
    pub(super) knots: Vec<[Amount; 2]>,
    pub(super) period: Amount,
    pub(super) angles: Vec<f64>,
    pub(super) turn: f64,
}

pub(super) struct Wave {
    order: Amount,
    size: Amount,
    sine: bool,
}

/// A curve on the board.
pub(super) enum Curved {
    Table(Table),
    Harmonics { constant: Amount, waves: Vec<Wave> },
}

impl Curved {
    pub(super) fn new(board: &mut Board, curve: &Curve) -> Self {
        match curve {
            Curve::Table { knots, period } => Self::Table(Table {
                knots: knots.iter().map(|knot| knot.map(|number| board.amount(number))).collect(),
                period: board.amount(*period),
                angles: knots.iter().map(|[at, _]| at.value).collect(),
                turn: period.value,
            }),
            Curve::Harmonics { constant, sin, cos } => {
                let constant = board.amount(*constant);
                let all = sin.iter().map(|wave| (wave, true)).chain(cos.iter().map(|wave| (wave, false)));
                let waves = all.map(|(wave, sine)| Wave {
                    order: board.amount(wave.order),
                    size: board.amount(wave.size),
                    sine,
                });
                Self::Harmonics { constant, waves: waves.collect() }
            }
        }
    }

    /// The height at an angle, which stands at `place`; within `room` of a knot it is that of the knot, and where the
    /// curve leaps there that of the side from which one comes.
    pub(super) fn height(
        &self,
        board: &mut Board,
        (at, place): (Amount, f64),
        (limit, room): (Limit, f64),
        reason: Reason,
    ) -> Amount {
        match self {
            Self::Table(table) => table.height(board, (at, place), (limit, room), reason),
            Self::Harmonics { constant, waves } => harmonics(board, *constant, waves, at),
        }
    }

    /// The height at the angle of the input: where the curve leaps, that behind the leap. A drawing that will be run for
    /// other angles holds every piece of the table, and finds the one that counts there.
    pub(super) fn height_here(&self, board: &mut Board, at: Amount, reason: Reason) -> Amount {
        match self {
            Self::Table(table) if board.tape().will_be_run() => table.height_anywhere(board, at, reason),
            Self::Table(table) => {
                let place = at.value();
                let room = ON_KNOT * table.turn;
                table.height(board, (at, place), (Limit::After, room), reason)
            }
            Self::Harmonics { constant, waves } => harmonics(board, *constant, waves, at),
        }
    }
}

impl Table {
    fn height(
        &self,
        board: &mut Board,
        (mut at, mut place): (Amount, f64),
        (limit, room): (Limit, f64),
        reason: Reason,
    ) -> Amount {
        let Self { knots, period, angles, turn } = self;
        let (first, last) = (0, knots.len() - 1);
        let turns = libm::floor((place - angles[first] + room) / turn);
        if turns != 0.0 {
            let by = board.amount(crate::given::Given::exact(turns));
            let by = board.product(by, *period);
            at = board.difference(at, by);
            place -= turns * turn;
        }
        let here = |angle: &f64| (angle - place).abs() <= room;
        let closes = angles[last] - angles[first] >= turn - room;
        let found = match limit {
            Limit::Before if here(&angles[first]) && closes => Some(last),
            Limit::Before => angles.iter().position(&here),
            Limit::After => angles.iter().rposition(&here),
        };
        if let Some(found) = found {
            return knots[found][1];
        }
        let next = angles.partition_point(|angle| *angle <= place);
        let from = if next == 0 { knots[last] } else { knots[next - 1] };
        let to = match knots.get(next) {
            Some(to) => *to,
            None => self.first_again(board),
        };
        piece(board, [from, to], at, reason)
    }

    /// The first knot of the next period.
    fn first_again(&self, board: &mut Board) -> [Amount; 2] {
        let [at, size] = self.knots[0];
        [board.sum(at, self.period), size]
    }

    /// Every piece of the table, each times one where the angle is on it and zero elsewhere.
    fn height_anywhere(&self, board: &mut Board, at: Amount, reason: Reason) -> Amount {
        let exact = |board: &mut Board, value: f64| board.amount(crate::given::Given::exact(value));
        let start = self.knots[0][0];
        let room = exact(board, ON_KNOT);
        let from_start = board.difference(at, start);
        let periods = board.quotient(from_start, self.period, reason);
        let periods = board.sum(periods, room);
        let whole = board.whole(periods);
        // How much of the period has gone by, from nothing to all of it.
        let part = board.difference(periods, whole);
        let gone = board.product(whole, self.period);
        let here = board.difference(at, gone);
        // Zero where a part of the period has gone by, less one before.
        let step = |board: &mut Board, way: Amount| {
            let beyond = board.difference(part, way);
            board.whole(beyond)
        };
        let (begin, end) = (exact(board, 0.0), exact(board, 1.0));
        let mut past = step(board, begin);
        let mut sum: Option<Amount> = None;
        for (index, from) in self.knots.iter().enumerate() {
            let after = self.angles.get(index + 1);
            let to = match self.knots.get(index + 1) {
                Some(to) => *to,
                None => self.first_again(board),
            };
            let wide = match after {
                Some(after) => after > &self.angles[index],
                None => self.angles[0] + self.turn > self.angles[index],
            };
            if !wide {
                continue;
            }
            let way = match after {
                Some(_) => {
                    let way = board.difference(to[0], start);
                    board.quotient(way, self.period, reason)
                }
                None => end,
            };
            let passed = step(board, way);
            let on = board.difference(past, passed);
            let height = piece(board, [*from, to], here, reason);
            let height = board.product(on, height);
            sum = Some(match sum {
                Some(sum) => board.sum(sum, height),
                None => height,
            });
            past = passed;
        }
        match sum {
            Some(sum) => sum,
            None => self.knots[0][1],
        }
    }
}

/// Straight from knot to knot.
fn piece(board: &mut Board, [from, to]: [[Amount; 2]; 2], at: Amount, reason: Reason) -> Amount {
    let width = board.difference(to[0], from[0]);
    let rise = board.difference(to[1], from[1]);
    let along = board.difference(at, from[0]);
    let part = board.product(rise, along);
    let part = board.quotient(part, width, reason);
    board.sum(from[1], part)
}

/// The heights of turning arrows.
fn harmonics(board: &mut Board, constant: Amount, waves: &[Wave], at: Amount) -> Amount {
    let mut sum = constant;
    for wave in waves {
        let turn = board.product(wave.order, at);
        let angle = board.of_radians(turn);
        let arrow = board.protractor(angle);
        let [x, y] = board.components(arrow, wave.size);
        sum = board.sum(sum, if wave.sine { y } else { x });
    }
    sum
}
