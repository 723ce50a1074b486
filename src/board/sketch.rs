//! Rough errors of a long tape, at a cost that is the same for every operation.
//!
//! A running error forgets what errors have in common, and grows with every link of a long chain until it says nothing; a sweep
//! back through the whole tape remembers all of it, and costs the whole tape each time. Between them stands a sketch: every error
//! of its own is multiplied by a draw from the Cauchy distribution, and the products are carried along the tangents. What arrives
//! at a result is Σ ∂result/∂xₖ·ownₖ·cₖ, and since a weighted sum of Cauchy draws is one Cauchy draw times the sum of the sizes
//! of the weights, it tells Σ |∂result/∂xₖ|·ownₖ: the very sum of the sweep back, blurred by a draw. With sixteen draws side
//! by side twenty times their fourth largest falls below the sum once in some 10¹⁶ results, which is less than the machine itself errs.
//! So coarse an error serves to see that something does not matter: what the tangent leaves out, which is of second order; that a
//! divisor, or an answer, stands clear of its error. A bound that is told is always swept.
//!
//! The draws depend on the place on the tape only, so that a drawing has the same bounds wherever it is drawn.

use std::array;
use std::f64::consts::PI;
use std::sync::OnceLock;

use crate::lots::lot;

/// Draws side by side.
const DRAWS: usize = 16;
/// Values that a draw may have: a byte tells which.
const VALUES: usize = 1 << u8::BITS;
/// So many of the draws may be larger than the one that is taken.
const LARGER: usize = 3;
/// What the draw that is taken is multiplied by.
const SAFETY: f64 = 20.0;

/// What the errors of all slots up to one do together, as far as somebody has asked.
#[derive(Debug, Clone, Default)]
pub(super) struct Sketches {
    of_slots: Vec<[f64; DRAWS]>,
}

impl Sketches {
    /// How many slots are sketched.
    pub(super) fn len(&self) -> usize {
        self.of_slots.len()
    }

    /// Sketches the next slot: what it adds itself, and its operands with the partial derivatives by them.
    pub(super) fn push<'a>(&mut self, own: f64, operands: impl Iterator<Item = (&'a u32, f64)>) {
        let mut sketch = [0.0; DRAWS];
        // What is exact draws nothing; what errs without bound is sketched as such.
        if own > 0.0 {
            let draws = draws(self.of_slots.len());
            sketch = draws.map(|draw| draw * own);
        }
        for (&operand, partial) in operands.filter(|(_, partial)| *partial != 0.0) {
            for (sum, of_operand) in sketch.iter_mut().zip(self.of_slots[operand as usize]) {
                *sum += partial * of_operand;
            }
        }
        self.of_slots.push(sketch);
    }

    /// No smaller than what all slots together do to this one; infinite where that cannot be told.
    pub(super) fn error_of(&self, slot: u32) -> f64 {
        let Some(sketch) = self.of_slots.get(slot as usize) else { return f64::INFINITY };
        if sketch.iter().any(|draw| !draw.is_finite()) {
            return f64::INFINITY;
        }
        // The largest so far, in falling order.
        let mut largest = [0.0_f64; LARGER + 1];
        for mut size in sketch.map(f64::abs) {
            for place in &mut largest {
                (*place, size) = (place.max(size), place.min(size));
            }
        }
        SAFETY * largest[LARGER]
    }
}

/// The draws of a slot.
fn draws(slot: usize) -> [f64; DRAWS] {
    static QUANTILES: OnceLock<[f64; VALUES]> = OnceLock::new();
    let quantiles = QUANTILES
        .get_or_init(|| array::from_fn(|value| libm::tan(PI * ((value as f64 + 0.5) / VALUES as f64 - 0.5))));
    let bytes = [2 * slot, 2 * slot + 1].map(|place| lot(place as u64).to_le_bytes());
    array::from_fn(|draw| quantiles[usize::from(bytes[draw / 8][draw % 8])])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lots::Lots;

    /// Random tapes, against the sum of the sweep back.
    #[test]
    fn sketches_lie_above_the_sum_and_near_it() {
        const SLOTS: usize = 600;
        for seed in 0..20 {
            let mut lots = Lots::new(seed);
            let mut part = || lots.draw() as f64 / u64::MAX as f64;
            let mut sketches = Sketches::default();
            let mut tape: Vec<(f64, [(u32, f64); 2])> = Vec::new();
            for slot in 0..SLOTS {
                let own = if part() < 0.2 { 0.0 } else { part() };
                let operands: [(u32, f64); 2] = array::from_fn(|_| match slot {
                    0 => (0, 0.0),
                    _ => ((slot as f64 * part().sqrt()) as u32, 1.2 * (2.0 * part() - 1.0)),
                });
                sketches.push(own, operands.iter().map(|(of, partial)| (of, *partial)));
                tape.push((own, operands));
            }
            for result in (SLOTS / 2..SLOTS).step_by(7) {
                let mut adjoint = vec![0.0; SLOTS];
                adjoint[result] = 1.0;
                let mut sum = 0.0;
                for slot in (0..=result).rev() {
                    let (own, operands) = tape[slot];
                    sum += own * f64::abs(adjoint[slot]);
                    for (of, partial) in operands {
                        adjoint[of as usize] += partial * adjoint[slot];
                    }
                }
                let told = sketches.error_of(result as u32);
                assert!(sum < told && told < 2000.0 * sum, "{seed} {result}: {told} of {sum}");
            }
        }
    }

    #[test]
    fn what_errs_without_bound_is_told_as_such() {
        let mut sketches = Sketches::default();
        sketches.push(f64::INFINITY, [].into_iter());
        sketches.push(0.0, [(&0, 0.0)].into_iter());
        sketches.push(1.0, [(&0, 1.0)].into_iter());
        assert_eq!(
            [0, 1, 2, 3].map(|slot| sketches.error_of(slot)),
            [f64::INFINITY, 0.0, f64::INFINITY, f64::INFINITY]
        );
    }
}
