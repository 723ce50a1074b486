//! What a careful human would get from the same drawing: each answer's error by pencil, ruler and set
//! square.

use std::f64::consts::PI;

use crate::board::{Board, Hand, Tape};
use crate::mechanism::Mechanism;
use crate::mechanism::quantity::Quantity;
use crate::mechanism::structure::Structure;
use crate::plan::Plan;

use super::auxiliary::draw_for_forces;
use super::reading::{Marked, Numbers, numbers, read_all};
use super::trial::Searched;
use super::{DrawError, Scales, draw, draw_departing};

/// The error of one asked quantity, drawn by hand, in SI units (of a vector: the length of its error).
#[derive(Debug, Clone, PartialEq)]
pub struct HandError {
    /// What all slips can do at their worst, to first order; `None` for what has no number.
    pub worst: Option<f64>,
    /// Lines cross so flatly, or arcs nearly touch, that first order says little.
    pub flat: bool,
    /// How the draughtsmen's errors spread; `None` where nobody got an answer.
    pub spread: Option<Spread>,
    /// How many draughtsmen got no answer, because their lines or arcs did not meet.
    pub failed: usize,
    /// How far they are off in size and direction apart; `None` where nobody got an answer.
    pub slips: Option<Slips>,
}

/// How far draughtsmen are off, size and direction apart.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slips {
    /// Nineteen of twenty stay within.
    pub most: Slip,
    /// The worst of them, in every part.
    pub worst: Slip,
}

impl Slips {
    /// Of many draughtsmen.
    fn of(slips: &[Slip]) -> Option<Self> {
        let part = |of: fn(&Slip) -> f64| {
            let mut sorted: Vec<f64> = slips.iter().map(of).collect();
            sorted.sort_by(f64::total_cmp);
            spread(&sorted)
        };
        let [whole, size, turn] = [part(|s| s.whole)?, part(|s| s.size)?, part(|s| s.turn)?];
        Some(Self {
            most: Slip { whole: whole.most, size: size.most, turn: turn.most },
            worst: Slip { whole: whole.largest, size: size.largest, turn: turn.largest },
        })
    }
}

/// How far what was drawn is from what should be.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Slip {
    /// The number; of a vector the length of its error.
    pub whole: f64,
    /// The size of the number or the vector.
    pub size: f64,
    /// The direction of the vector, radians.
    pub turn: f64,
}

impl Slip {
    /// Between two sets of numbers of one quantity; an angle is the same a turn later.
    #[must_use]
    pub fn between(drawn: &[f64], perfect: &[f64], angle: bool) -> Self {
        let apart = |(a, b): (&f64, &f64)| {
            let apart = (a - b).abs();
            if angle { apart.min((2.0 * PI - apart).abs()) } else { apart }
        };
        let whole = drawn.iter().zip(perfect).map(apart).fold(0.0, libm::hypot);
        match (drawn, perfect) {
            ([a, b], [x, y]) => {
                let turn = libm::atan2(x * b - y * a, x * a + y * b).abs();
                Self { whole, size: (libm::hypot(*a, *b) - libm::hypot(*x, *y)).abs(), turn }
            }
            _ => Self { whole, size: whole, turn: 0.0 },
        }
    }

    /// The worse of two, in every part.
    #[must_use]
    pub fn worse(self, other: Self) -> Self {
        Self {
            whole: self.whole.max(other.whole),
            size: self.size.max(other.size),
            turn: self.turn.max(other.turn),
        }
    }

    fn is_finite(self) -> bool {
        self.whole.is_finite() && self.size.is_finite() && self.turn.is_finite()
    }
}

/// Errors of many draughtsmen, in ascending order.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spread {
    /// Half of them stay within.
    pub median: f64,
    /// Nineteen of twenty stay within.
    pub most: f64,
    /// The worst of them.
    pub largest: f64,
}

impl HandError {
    /// By how much the answer of a careful draughtsman may be off: nineteen of twenty stay within. `None`
    /// where the quantity cannot be drawn by hand.
    #[must_use]
    pub fn tolerance(&self) -> Option<f64> {
        self.spread.map(|spread| spread.most)
    }
}

/// How the drawing is made by hand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Draughtsmen {
    /// Their hand.
    pub hand: Hand,
    /// How many of them draw.
    pub number: u64,
}

/// The errors that draughtsmen make in each asked quantity, at these scales.
///
/// # Errors
/// As [`super::construct`], where not even a perfect hand can draw it.
pub fn by_hand(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
    draughtsmen: Draughtsmen,
) -> Result<Vec<HandError>, DrawError> {
    let hand = draughtsmen.hand;
    let searched = Searched::by_hands();
    let drawn_on = |board| draw_departing(board, mechanism, structure, plan, scales, (&[], Some(&searched)));
    let mut perfect = drawn_on(Board::new(Tape::by_hand(hand)))?;
    draw_for_forces(&mut perfect, plan);
    let readings: Vec<_> = read_all(&mut perfect).into_iter().map(|read| read.numbers).collect();
    let mut errors: Vec<Vec<Slip>> = vec![Vec::new(); readings.len()];
    for seed in 0..draughtsmen.number {
        let Ok(mut drawn) = drawn_on(Board::new(Tape::trembling(hand, seed))) else { continue };
        draw_for_forces(&mut drawn, plan);
        for (index, read) in read_all(&mut drawn).into_iter().enumerate() {
            let turns = matches!(mechanism.asked[index].quantity, Quantity::Angle(_));
            errors[index].extend(apart(&read.numbers, &readings[index], turns));
        }
    }
    let mut results = Vec::with_capacity(readings.len());
    for (numbers, slips) in readings.iter().zip(errors) {
        let mut errors: Vec<f64> = slips.iter().map(|slip| slip.whole).collect();
        errors.sort_by(f64::total_cmp);
        let marks: Vec<u32> = numbers.iter().flatten().map(|(mark, _)| *mark).collect();
        let tape = perfect.board.tape();
        let worst = marks.iter().fold(0.0, |sum, &mark| libm::hypot(sum, tape.worst(mark)));
        let flat = marks.iter().any(|&mark| tape.weakness(mark).is_some());
        let all = usize::try_from(draughtsmen.number).unwrap_or(usize::MAX);
        results.push(HandError {
            worst: (numbers.is_ok() && worst.is_finite()).then_some(worst),
            flat,
            spread: spread(&errors),
            failed: all - errors.len(),
            slips: Slips::of(&slips),
        });
    }
    Ok(results)
}

/// What one draughtsman reads, whose slips follow from a seed.
///
/// # Errors
/// See [`DrawError`]: lines or arcs that do not meet under this hand.
pub fn by_one_hand(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
    (hand, seed): (Hand, u64),
) -> Result<Vec<Option<Numbers<f64>>>, DrawError> {
    let board = Board::new(Tape::trembling(hand, seed));
    let mut drawn = draw(board, mechanism, structure, plan, scales)?;
    draw_for_forces(&mut drawn, plan);
    Ok(numbers(&mut drawn, |_, _| Some(None)))
}

/// How far an answer is from the perfect one.
fn apart(drawn: &Marked, perfect: &Marked, turns: bool) -> Option<Slip> {
    let (Ok(drawn), Ok(perfect)) = (drawn, perfect) else { return None };
    let values = |numbers: &[(u32, f64)]| numbers.iter().map(|(_, value)| *value).collect::<Vec<f64>>();
    let slip = Slip::between(&values(drawn), &values(perfect), turns);
    slip.is_finite().then_some(slip)
}

/// The errors of a number that draughtsmen read off another drawing; none for whoever got no answer.
#[must_use]
pub fn errors_of(read: &[Option<f64>], perfect: Option<f64>) -> HandError {
    let mut errors: Vec<f64> = perfect
        .map_or_else(Vec::new, |perfect| read.iter().flatten().map(|own| (own - perfect).abs()).collect());
    errors.retain(|error| error.is_finite());
    errors.sort_by(f64::total_cmp);
    let spread = spread(&errors);
    let worst = spread.map(|s| s.largest);
    let whole = |size: f64| Slip { whole: size, size, turn: 0.0 };
    let slips = spread.map(|s| Slips { most: whole(s.most), worst: whole(s.largest) });
    HandError { worst, flat: false, spread, failed: read.len() - errors.len(), slips }
}

fn spread(sorted: &[f64]) -> Option<Spread> {
    let at = |part: usize, of: usize| sorted.get((sorted.len() * part / of).min(sorted.len().max(1) - 1));
    Some(Spread { median: *at(1, 2)?, most: *at(19, 20)?, largest: *sorted.last()? })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mechanism::quantity::Order;
    use crate::plan::Extent;

    /// A hundred hands draw a Stephenson six-bar by trial: all ways in which it closes are searched through once or twice, and each
    /// hand gets to the last bit what it would get if it searched by itself.
    #[test]
    fn hands_that_slip_search_next_to_the_perfect_hand() {
        let kind = crate::catalogue::KINDS.iter().find(|kind| kind.name == "stephenson").unwrap();
        let scene = crate::scene::read(kind.scene, kind.name).unwrap();
        let mechanism = &scene.mechanism;
        let structure = Structure::of(mechanism).unwrap();
        assert!(!structure.trials.is_empty());
        let plan = Plan::new(mechanism, &structure, Extent::Asked);
        assert!(!plan.steps(Order::Velocity).is_empty());
        let solved = crate::solve::solve(&scene, Extent::Asked, crate::sheet::scale::for_scene).unwrap();
        let hand = Hand { length: 0.2, angle: 0.3_f64.to_radians() };
        let searched = Searched::by_hands();
        let drawn = |tape: Tape, searched: Option<&Searched>| {
            let (board, of) = (Board::new(tape), (&[] as &[_], searched));
            let mut drawn = draw_departing(board, mechanism, &structure, &plan, solved.scales, of).ok()?;
            Some(numbers(&mut drawn, |_, _| Some(None)))
        };
        assert!(drawn(Tape::by_hand(hand), Some(&searched)).is_some());
        let mut compared = 0;
        for seed in 0..100 {
            let with = drawn(Tape::trembling(hand, seed), Some(&searched));
            if seed < 10 {
                let alone: Option<Vec<Option<Numbers<f64>>>> = drawn(Tape::trembling(hand, seed), None);
                assert_eq!(format!("{with:?}"), format!("{alone:?}"), "hand {seed}");
                compared += usize::from(with.is_some());
            }
        }
        // Whoever's slips leave no closing next to the perfect one searches for himself.
        assert!(searched.searches() <= 2, "{} searches", searched.searches());
        assert_eq!(compared, 10);
    }
}
