//! What a drawing found by trial, found again for another place: where what is tried misses its open constraint by
//! nothing, and how the miss changes there.
//!
//! The search is Newton's, from where the last place leads one to expect the root, and halves where that leads
//! to and fro. It computes by values alone, so that whoever runs a drawing for one place or for
//! many finds the same doubles.

use crate::given::Given;

/// Steps of a search, at most: at a fold, where two roots become one, each only halves what is left.
const MOST_STEPS: usize = 60;
/// On scratch paper a slope is a difference over this part of the unit to either side.
const DIFFERENCE: f64 = 1e-6;
/// No step is longer than this part of the unit.
const LONGEST_STEP: f64 = 0.1;
/// What has gone beyond the end of what closes comes back by so many times as much.
const PULL: f64 = 1.5;
/// A root farther from where it is expected than this part of the unit is another one.
const REACH: f64 = 0.5;
/// Two to this power: what is found is rounded to a part so fine of a unit of the paper or a radian. What is left is for
/// the step of false position behind it, which squares it; and whoever searches on another way finds the same double.
const GRID: f64 = 1_099_511_627_776.0;
/// A search that comes no nearer has arrived where its last step was below this part of the unit.
const ARRIVED: f64 = 1e-7;

/// How far a slope that was carried along with the miss may be off, as a part of it: the roundings of some thousand
/// operations.
pub(super) const CARRIED: f64 = 1e-9;

/// What a search sees at `N` places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Seen<const N: usize> {
    /// By how much the constraint is missed, and how that changes with what is tried.
    pub(super) miss: [[f64; N]; 2],
    /// The square of a half chord that cannot be drawn there, and how it changes; zero where all can be drawn.
    pub(super) apart: [[f64; N]; 2],
}

/// Finds where next to nothing is missed, near `expected`: not a number where there is no such place. In which sense it
/// changes there, 1 or −1, is told where that is known, else 0: beyond a fold it changes the other way. `unit` is how far
/// what is tried may go at once.
pub(super) fn find<const N: usize>(
    expected: &[f64; N],
    sense: &[f64; N],
    unit: f64,
    mut look: impl FnMut(&[f64; N]) -> Seen<N>,
) -> [f64; N] {
    let mut at = *expected;
    // Newton's step where each was last, and how far each went from there.
    let (mut last, mut gone) = ([f64::INFINITY; N], [f64::INFINITY; N]);
    // Where something was missed by less than nothing, and by more.
    let (mut below, mut above) = ([f64::NAN; N], [f64::NAN; N]);
    // Where it closed, and changed in the sense that is wanted.
    let mut before_fold = [f64::NAN; N];
    let mut done = [false; N];
    for _ in 0..MOST_STEPS {
        let Seen { miss: [here, slope], apart } = look(&at);
        for i in 0..N {
            if done[i] {
                continue;
            }
            if apart[0][i] < 0.0 && before_fold[i].is_nan() {
                // Beyond the end of what closes: half as far inside.
                let back = PULL * apart[0][i] / apart[1][i];
                at[i] -= back.clamp(-LONGEST_STEP * unit, LONGEST_STEP * unit);
                continue;
            }
            if (apart[0][i] < 0.0 || sense[i] * slope[i] < 0.0) && !before_fold[i].is_nan() {
                gone[i] = 0.5 * (before_fold[i] - at[i]).abs();
                at[i] = f64::midpoint(before_fold[i], at[i]);
                continue;
            }
            before_fold[i] = at[i];
            let step = here[i] / slope[i];
            let size = step.abs();
            let arrived = size <= 4.0 * f64::EPSILON * at[i].abs().max(unit);
            let stays = size >= last[i] && size <= ARRIVED * unit;
            last[i] = if stays { last[i] } else { size };
            done[i] = arrived || stays || size.is_nan();
            if done[i] {
                continue;
            }
            if here[i] < 0.0 {
                below[i] = at[i];
            } else {
                above[i] = at[i];
            }
            let mut next = at[i] - step.clamp(-LONGEST_STEP * unit, LONGEST_STEP * unit);
            let (low, high) = (below[i].min(above[i]), below[i].max(above[i]));
            // Between two misses of either sign no step leads out, nor to and fro.
            let enclosed = !below[i].is_nan() && !above[i].is_nan();
            if enclosed && !(low < next && next < high && size <= 0.5 * gone[i]) {
                next = f64::midpoint(low, high);
            }
            gone[i] = (next - at[i]).abs();
            at[i] = next;
        }
        if done.iter().all(|done| *done) {
            break;
        }
    }
    for i in 0..N {
        let found = last[i] <= ARRIVED * unit && (at[i] - expected[i]).abs() <= REACH * unit;
        at[i] = if found { (at[i] * GRID + 0.5).floor() / GRID } else { f64::NAN };
    }
    at
}

/// Where a miss that was found to vanish at `near` vanishes, rounded to 2⁻⁴⁰, and how it changes there; neither where it
/// does not.
pub fn found_by_trial(
    near: f64,
    unit: f64,
    mut miss: impl FnMut(f64) -> Option<f64>,
) -> (Option<f64>, Option<Given>) {
    let width = DIFFERENCE * unit;
    let mut value = |at: f64| miss(at).unwrap_or(f64::NAN);
    let [at] = find(&[near], &[0.0], unit, |&[at]| {
        let here = value(at);
        Seen { miss: [[here], [(value(at + width) - here) / width]], apart: [[0.0]; 2] }
    });
    let mut difference = |width: f64| (value(at + width) - value(at - width)) / (2.0 * width);
    let (fine, coarse) = (difference(width), difference(2.0 * width));
    let error = (fine - coarse).abs();
    let slope = (fine.is_finite() && error.is_finite()).then(|| Given::within(fine, error));
    (at.is_finite().then_some(at), slope)
}

#[cfg(test)]
mod tests {
    use super::{Seen, find};

    fn closing<const N: usize>(miss: [[f64; N]; 2]) -> Seen<N> {
        Seen { miss, apart: [[0.0; N]; 2] }
    }

    #[test]
    fn a_root_near_the_expected_place_is_found() {
        let found = find(&[1.5, 1.6, -1.5], &[0.0; 3], 1.0, |x| {
            closing([x.map(|x| 100.0 * libm::sin(2.0 * x)), x.map(|x| 200.0 * libm::cos(2.0 * x))])
        });
        let half_turn = std::f64::consts::FRAC_PI_2;
        for (at, root) in found.into_iter().zip([half_turn, half_turn, -half_turn]) {
            assert!((at - root).abs() < 1e-12, "{at}");
        }
    }

    #[test]
    fn where_nothing_vanishes_nothing_is_found() {
        // The second has a double root, which is still found; the third misses it by little.
        let found = find(&[0.1, 0.1, 0.1], &[1.0; 3], 1.0, |x| {
            closing([[x[0] * x[0] + 1.0, x[1] * x[1], x[2] * x[2] + 1e-9], x.map(|x| 2.0 * x)])
        });
        assert!(found[0].is_nan() && found[2].is_nan());
        assert!(found[1].abs() < 1e-6);
    }

    /// √(1 − x) = near, expected on this side of its end and beyond.
    #[test]
    fn a_root_next_to_the_end_of_a_chord_is_found() {
        for near in [1e-2, 1e-4] {
            for expected in [1.0 - 0.1 * near * near, 1.0 - 9.0 * near * near, 1.0 + near] {
                let found = find(&[expected], &[-1.0], 1.0, |&[x]| {
                    let chord = (1.0 - x).max(0.0).sqrt();
                    let apart = if x > 1.0 { [[1.0 - x], [-1.0]] } else { [[0.0]; 2] };
                    Seen { miss: [[chord - near], [if chord > 0.0 { -0.5 / chord } else { 0.0 }]], apart }
                });
                assert!((found[0] - (1.0 - near * near)).abs() < 1e-12, "{near} {expected}: {found:?}");
            }
        }
    }
}
