//! Rough radii of a long chain of groups, at the same cost for every group.
//!
//! What each row of a group and each parameter errs by is drawn from the Cauchy distribution, sixteen times side by side, and
//! solved for, group by group, as the unknowns themselves are. A weighted sum of independent Cauchy draws is one draw times the
//! sum of the sizes of the weights, which is the sum that a sweep back through all equations adds up: what rows and parameters
//! have in common cancels here as it does there. Twenty times the fourth largest of sixteen falls below that sum once in some
//! 10¹⁶ numbers. So coarse a radius (it may be a few thousand times too large) tells that a group is regular; bounds of answers
//! never come from it.

use std::array;
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Draws side by side.
pub(super) const DRAWS: usize = 16;
/// So many of them may be larger than the one that is taken, and what that is multiplied by.
const LARGER: usize = 3;
const SAFETY: f64 = 20.0;

/// Draws of one number: what an unknown errs by, or one unit of what is not known better.
pub(super) type Draws = [f64; DRAWS];

/// The middle of each of 256 equally likely parts of the distribution.
static PARTS: LazyLock<[f64; 256]> =
    LazyLock::new(|| array::from_fn(|part| libm::tan(PI * ((part as f64 + 0.5) / 256.0 - 0.5))));

/// What draws are of, to be drawn independently.
#[derive(Debug, Clone, Copy)]
pub(super) enum Source {
    /// How far an equation misses.
    Row(usize),
    /// A given number.
    Param(usize),
    /// An unknown of which only a width is known.
    Width(usize),
}

/// The draws of a source: always the same, whatever else is drawn.
pub(super) fn draws_of(source: Source) -> Draws {
    let (kind, at) = match source {
        Source::Row(at) => (1, at),
        Source::Param(at) => (2, at),
        Source::Width(at) => (3, at),
    };
    // Steps of a generator by Marsaglia (xorshift64*), whose high bytes pass for independent.
    let mut state = (at as u64).wrapping_mul(0xd134_2543_de82_ef95) ^ (kind << 61) ^ 0x5851_f42d_4c95_7f2d;
    for _ in 0..3 {
        state = step(state);
    }
    array::from_fn(|_| {
        state = step(state);
        PARTS[(state.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 56) as usize]
    })
}

fn step(mut state: u64) -> u64 {
    state ^= state >> 12;
    state ^= state << 25;
    state ^ (state >> 27)
}

/// No smaller than the sum that these draws are of; infinite where it cannot be told.
pub(super) fn size(draws: &Draws) -> f64 {
    if draws.iter().any(|draw| !draw.is_finite()) {
        return f64::INFINITY;
    }
    let mut sizes = draws.map(f64::abs);
    sizes.sort_by(|a, b| b.total_cmp(a));
    SAFETY * sizes[LARGER]
}

/// Adds so many times one row of draws to another; what does not count may err without bound.
pub(super) fn add(to: &mut Draws, factor: f64, draws: &Draws) {
    if factor != 0.0 {
        for (to, draw) in to.iter_mut().zip(draws) {
            *to += factor * draw;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sums of a few to many terms of very different sizes, of all three kinds.
    #[test]
    fn a_size_lies_above_the_sum_and_near_it() {
        for seed in 0..2_000_usize {
            let terms = 1 + seed % 60;
            let (mut sum, mut drawn) = (0.0, [0.0; DRAWS]);
            for term in 0..terms {
                let at = 60 * seed + term;
                let weight = libm::sin(at as f64 + 1.0) * libm::pow(10.0, -((at % 7) as f64));
                let source = [Source::Row, Source::Param, Source::Width][at % 3];
                add(&mut drawn, weight, &draws_of(source(at)));
                sum += weight.abs();
            }
            let told = size(&drawn);
            assert!(sum < told && told < 5000.0 * sum, "{seed}: {told} of {sum}");
        }
    }

    #[test]
    fn what_errs_without_bound_is_told_as_such() {
        let mut drawn = draws_of(Source::Row(7));
        add(&mut drawn, 0.0, &[f64::INFINITY; DRAWS]);
        assert!(size(&drawn).is_finite());
        add(&mut drawn, 1.0, &[f64::INFINITY; DRAWS]);
        assert_eq!(size(&drawn), f64::INFINITY);
    }
}
