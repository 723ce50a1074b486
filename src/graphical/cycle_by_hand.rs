//! A turning-moment diagram as a hand draws it: its curves pricked on paper and read off again, before areas are taken.

use crate::board::{Amount, Board, Hand, Scale, Tape};
use crate::given::Given;
use crate::mechanism::curve::{Curve, Harmonic};
use crate::mechanism::cycle::{Course, Cycle, CycleQuantity, Sides};

/// The torque of a mechanism is found at so many angles, and a line drawn through what was found.
const ORDINATES: usize = 24;

/// What one draughtsman has before him.
#[derive(Debug, Clone)]
pub struct DrawnByHand {
    /// The curves as they stand on his paper; areas that are given are no drawing.
    pub cycle: Cycle,
    /// By how much his ordinates of the mechanism's own torque are off, N m, at equal angles of the period.
    misses: Vec<f64>,
    /// By how much he misreads an angle, radians, by turns.
    misread: Vec<f64>,
}

/// The diagram as this draughtsman draws it: newton metres and radians for a millimetre of his paper, his hand and the
/// seed of his dice.
#[must_use]
pub fn drawn_by_hand(cycle: &Cycle, [torque, angle]: [f64; 2], hand: Hand, seed: u64) -> DrawnByHand {
    let mut paper = Pencil { board: Board::new(Tape::trembling(hand, seed)), torque, angle };
    let mut drawn = cycle.clone();
    match &mut drawn.sides {
        Sides::Torque(course) | Sides::Load(course) => paper.course(course),
        Sides::Both { torque, load } => {
            paper.course(torque);
            paper.course(load);
            level(torque, load);
        }
        Sides::Areas { .. } => {}
    }
    let misses = (0..ORDINATES).map(|_| paper.height(Given::exact(0.0)).value).collect();
    let misread = (0..ORDINATES).map(|_| paper.read_angle()).collect();
    DrawnByHand { cycle: drawn, misses, misread }
}

/// Lifts the load's curve to the mean of the torque's: what drives and what resists do the same work in a period, and who
/// draws both sets them so.
fn level(torque: &Course, load: &mut Course) {
    if let (Course::Curve(torque), Course::Curve(load)) = (torque, load) {
        let lift = mean(torque) - mean(load);
        match load {
            Curve::Table { knots, .. } => {
                knots.iter_mut().for_each(|[_, height]| *height = Given::exact(height.value + lift));
            }
            Curve::Harmonics { constant, .. } => *constant = Given::exact(constant.value + lift),
        }
    }
}

/// The mean height of a curve.
fn mean(curve: &Curve) -> f64 {
    match curve {
        Curve::Harmonics { constant, .. } => constant.value,
        Curve::Table { knots, period } => {
            let knot = |[at, height]: &[Given; 2]| (at.value, height.value);
            let again = knots.first().map(knot).map(|(at, height)| (at + period.value, height));
            let all: Vec<(f64, f64)> = knots.iter().map(knot).chain(again).collect();
            let area: f64 =
                all.windows(2).map(|two| (two[1].0 - two[0].0) * (two[0].1 + two[1].1) / 2.0).sum();
            area / period.value
        }
    }
}

impl DrawnByHand {
    /// By how much the mechanism's own torque is off at an angle of the input.
    #[must_use]
    pub fn missed(&self, at: f64) -> f64 {
        let place = libm::fmod(at, self.cycle.period.value) / self.cycle.period.value;
        let place = if place < 0.0 { place + 1.0 } else { place } * ORDINATES as f64;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "between 0 and a few")]
        let first = libm::floor(place) as usize;
        let of = |index: usize| self.misses[index % ORDINATES];
        let part = place - libm::floor(place);
        of(first) * (1.0 - part) + of(first + 1) * part
    }

    /// A number of the diagram as he reads it.
    #[must_use]
    pub fn read(&self, of: CycleQuantity, value: f64) -> f64 {
        let nth = match of {
            CycleQuantity::Crossing(k) => k as usize,
            _ => 0,
        };
        if of.is_angle() { value + self.misread[nth % ORDINATES] } else { value }
    }
}

/// A pencil on the paper of a diagram.
struct Pencil {
    board: Board,
    torque: f64,
    angle: f64,
}

impl Pencil {
    fn course(&mut self, course: &mut Course) {
        match course {
            Course::Of(_) => {}
            Course::Curve(Curve::Table { knots, period }) => {
                // Where the curve leaps or comes again it is one mark, and no knot passes another.
                let angles = || knots.iter().map(|[at, _]| at.value);
                let (first, last) =
                    (angles().fold(f64::INFINITY, f64::min), angles().fold(f64::NEG_INFINITY, f64::max));
                let comes_again = last - first >= period.value;
                let given = knots.clone();
                for (index, knot) in given.iter().enumerate() {
                    let [at, height] = *knot;
                    let own = at.value;
                    knots[index][0] = match index.checked_sub(1) {
                        Some(before) if given[before][0].value == own => knots[before][0],
                        _ if own == first || own == last => at,
                        Some(before) => {
                            let after = given[index..].iter().map(|[at, _]| at.value).find(|at| *at > own);
                            self.place(at, [given[before][0].value, after.unwrap_or(last)])
                        }
                        None => at,
                    };
                    let closes = comes_again && index + 1 == given.len() && given[0][1].value == height.value;
                    knots[index][1] = if closes { knots[0][1] } else { self.height(height) };
                }
            }
            Course::Curve(Curve::Harmonics { constant, sin, cos }) => {
                *constant = self.height(*constant);
                for Harmonic { size, .. } in sin.iter_mut().chain(cos) {
                    *size = self.height(*size);
                }
            }
        }
    }

    /// A height laid off and read.
    fn height(&mut self, given: Given) -> Given {
        let amount = self.board.amount(given);
        let drawn = self.through_paper(amount, self.torque);
        Given::exact(drawn.value())
    }

    /// An angle between its neighbours, laid off and read.
    fn place(&mut self, given: Given, [before, after]: [f64; 2]) -> Given {
        let amount = self.board.amount(given);
        let drawn = self.through_paper(amount, self.angle).value();
        let room = [0.25, 0.75];
        let least = before + room[1] * (given.value - before);
        let most = given.value + room[0] * (after - given.value);
        Given::exact(drawn.clamp(least, most))
    }

    fn read_angle(&mut self) -> f64 {
        let none = self.board.amount(Given::exact(0.0));
        self.through_paper(none, self.angle).value()
    }

    fn through_paper(&mut self, amount: Amount, si_per_mm: f64) -> Amount {
        let scale = Scale { si_per_mm };
        let mm = self.board.to_paper(amount, scale);
        let pole = self.board.origin();
        let along = self.board.rightward();
        let mark = self.board.step_off(pole, along, mm);
        let [x, _] = self.board.between(pole, mark);
        self.board.read(x, scale)
    }
}
