//! The drawing is the computation: a stroke that is moved on the paper moves the answers, and to first
//! order by just as much as the tape says.
//!
//! For a nudge h, answer(h) − answer(0) − S·h has an even part (h², h⁴ …) and an odd part (h³ …), where S
//! is the sensitivity that the tape states. When h is halved the even part must fall four-fold and the odd
//! part eight-fold; a wrong S leaves an odd part that only halves.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use linkgram::board::{Nudge, PointRecord, Tape};
use linkgram::graphical::{Solution, construct_on};
use linkgram::mechanism::quantity::Answer;

/// The nudge, in millimetres of paper.
const NUDGE: f64 = 0.1;

/// The numbers behind each tape slot of the answers, with their bounds.
fn numbers(solution: &Solution) -> Vec<(u32, f64, f64)> {
    let mut numbers = Vec::new();
    for (reading, slots) in solution.construction.answers.iter().zip(&solution.slots) {
        match (&reading.answer, slots.as_slice()) {
            (Answer::Scalar { value, bound }, &[slot]) => numbers.push((slot, *value, *bound)),
            (Answer::Vector { value, bound }, &[x, y]) => {
                numbers.push((x, value[0], *bound));
                numbers.push((y, value[1], *bound));
            }
            other => panic!("an answer without its slots: {other:?}"),
        }
    }
    numbers
}

/// Nudges every stroke of a scene; says how many strokes there are, and how many answers moved in all.
fn nudge_all(stem: &str) -> (usize, usize) {
    let mut drawn = common::draw(&common::example(stem));
    let rest = numbers(&drawn.solution);
    let strokes: Vec<PointRecord> = drawn.solution.tape.strokes().to_vec();
    let (mechanism, structure, plan) = (&drawn.scene.mechanism, &drawn.structure, &drawn.plan);
    let mut moved = 0;
    for (index, stroke) in strokes.iter().enumerate() {
        for axis in 0..2 {
            let nudged = |by: f64| {
                let mut nudge = Nudge { stroke: index, by: [0.0; 2] };
                nudge.by[axis] = by;
                let tape = Tape::nudged(nudge);
                numbers(&construct_on(tape, mechanism, structure, plan, drawn.scales).unwrap())
            };
            let whole = [nudged(NUDGE), nudged(-NUDGE)];
            let half = [nudged(NUDGE / 2.0), nudged(-NUDGE / 2.0)];
            for (at, &(slot, value, bound)) in rest.iter().enumerate() {
                let slope = drawn.solution.tape.sensitivity(slot, stroke.slots[axis]);
                let parts = |pair: &[Vec<(u32, f64, f64)>; 2], h: f64| {
                    let left = [pair[0][at].1 - value - slope * h, pair[1][at].1 - value + slope * h];
                    [(left[0] + left[1]) / 2.0, (left[0] - left[1]) / 2.0]
                };
                let [even, odd] = parts(&whole, NUDGE);
                let [half_even, half_odd] = parts(&half, NUDGE / 2.0);
                // Rounding: that of the three drawings, and of the slope itself.
                let noise = 4.0 * bound + 1e-12 * (slope * NUDGE).abs();
                // The next order is smaller by (h / length of what is drawn)²: two per cent.
                let place = || format!("{stem}: stroke {index} ({}), answer {at}", stroke.purpose);
                assert!(
                    half_even.abs() <= 1.02 * even.abs() / 4.0 + noise,
                    "{}: {even:e} falls to {half_even:e}",
                    place()
                );
                assert!(
                    half_odd.abs() <= 1.02 * odd.abs() / 8.0 + noise,
                    "{}: {odd:e} falls to {half_odd:e}, slope {slope:e}",
                    place()
                );
                moved += usize::from((whole[0][at].1 - whole[1][at].1).abs() > 4.0 * bound);
            }
        }
    }
    (strokes.len(), moved)
}

#[test]
fn every_stroke_of_problem_3_1_moves_the_answers_as_the_tape_says() {
    let (strokes, moved) = nudge_all("s000-ch3a-1");
    assert!(strokes >= 20 && moved > 300, "{strokes} strokes, {moved} moves");
}

#[test]
fn every_stroke_of_the_eight_link_chain_moves_the_answers_as_the_tape_says() {
    let (strokes, moved) = nudge_all("eight-link");
    assert!(strokes >= 30 && moved > 300, "{strokes} strokes, {moved} moves");
}

#[test]
fn every_stroke_of_the_integer_four_bar_moves_the_answers_as_the_tape_says() {
    let (strokes, moved) = nudge_all("s000-ch7-9-36");
    assert!(strokes >= 8 && moved > 30, "{strokes} strokes, {moved} moves");
}
