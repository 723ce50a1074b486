//! What a drawing found by trial, found again for another place: where what is tried misses its open constraint by
//! nothing, and how the miss changes there.
//!
//! The search is Newton's, with differences for slopes, from where the last place leads one to expect the root, and
//! halves where that leads to and fro. It computes by values alone, so that whoever runs a drawing for one place or for
//! many finds the same doubles.

use crate::given::Given;

/// Steps of a search, at most: at a fold, where two roots become one, each only halves what is left.
const MOST_STEPS: usize = 60;
/// A slope is a difference over this part of the unit to either side.
const DIFFERENCE: f64 = 1e-6;
/// No step is longer than this part of the unit.
const LONGEST_STEP: f64 = 0.1;
/// A root farther from where it is expected than this part of the unit is another one.
const REACH: f64 = 0.5;
/// Two to this power: what is found is rounded to a part so fine of a unit of the paper or a radian. What is left is for
/// the step of false position behind it, which squares it; and whoever searches on another way finds the same double.
const GRID: f64 = 1_099_511_627_776.0;
/// A search that comes no nearer has arrived where its last step was below this part of the unit.
const ARRIVED: f64 = 1e-7;

/// What was found for `N` places.
#[derive(Debug, Clone, Copy)]
pub(super) struct Found<const N: usize> {
    /// Where next to nothing is missed; not a number where there is no such place near the one that was expected.
    pub(super) at: [f64; N],
    /// How the miss changes there.
    pub(super) slope: [f64; N],
    /// How far the slope may be off, by differences of two widths.
    pub(super) slope_error: [f64; N],
}

/// Finds where nothing is missed, near `expected`; in which sense the miss changes there, 1 or −1, where that is known, else
/// 0: beyond a fold it changes the other way. `unit` is how far what is tried may go at once.
pub(super) fn find<const N: usize>(
    expected: &[f64; N],
    sense: &[f64; N],
    unit: f64,
    mut miss: impl FnMut(&[f64; N]) -> [f64; N],
) -> Found<N> {
    let width = DIFFERENCE * unit;
    let mut at = *expected;
    // Newton's step where each was last, and how far each went from there.
    let (mut last, mut gone) = ([f64::INFINITY; N], [f64::INFINITY; N]);
    // Where something was missed by less than nothing, and by more.
    let (mut below, mut above) = ([f64::NAN; N], [f64::NAN; N]);
    // Where it changed in the sense that is wanted.
    let mut before_fold = [f64::NAN; N];
    let mut done = [false; N];
    for _ in 0..MOST_STEPS {
        let here = miss(&at);
        let ahead = miss(&at.map(|x| x + width));
        for i in 0..N {
            if done[i] {
                continue;
            }
            if sense[i] * (ahead[i] - here[i]) < 0.0 && !before_fold[i].is_nan() {
                gone[i] = 0.5 * (before_fold[i] - at[i]).abs();
                at[i] = f64::midpoint(before_fold[i], at[i]);
                continue;
            }
            before_fold[i] = at[i];
            let step = here[i] * width / (ahead[i] - here[i]);
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
    let mut difference = |width: f64| -> [f64; N] {
        let [ahead, behind] = [width, -width].map(|by| miss(&at.map(|x| x + by)));
        std::array::from_fn(|i| (ahead[i] - behind[i]) / (2.0 * width))
    };
    let (fine, coarse) = (difference(width), difference(2.0 * width));
    Found { at, slope: fine, slope_error: std::array::from_fn(|i| (fine[i] - coarse[i]).abs()) }
}

/// Where a miss that was found to vanish at `near` vanishes, rounded to 2⁻⁴⁰, and how it changes there; neither where it
/// does not.
pub fn found_by_trial(
    near: f64,
    unit: f64,
    mut miss: impl FnMut(f64) -> Option<f64>,
) -> (Option<f64>, Option<Given>) {
    let Found { at: [at], slope: [slope], slope_error: [error] } =
        find(&[near], &[0.0], unit, |&[at]| [miss(at).unwrap_or(f64::NAN)]);
    let slope = (slope.is_finite() && error.is_finite()).then(|| Given::within(slope, error));
    (at.is_finite().then_some(at), slope)
}

#[cfg(test)]
mod tests {
    use super::find;

    #[test]
    fn a_root_near_the_expected_place_is_found() {
        let found = find(&[1.5, 1.6, -1.5], &[0.0; 3], 1.0, |x| x.map(|x| 100.0 * libm::sin(2.0 * x)));
        let half_turn = std::f64::consts::FRAC_PI_2;
        for (at, root) in found.at.into_iter().zip([half_turn, half_turn, -half_turn]) {
            assert!((at - root).abs() < 1e-12, "{at}");
        }
        for (slope, error) in found.slope.into_iter().zip(found.slope_error) {
            assert!((slope + 200.0).abs() < 1e-6 && error < 1e-6, "{slope} {error}");
        }
    }

    #[test]
    fn where_nothing_vanishes_nothing_is_found() {
        // The second has a double root, which is still found; the third misses it by little.
        let misses = |x: &[f64; 3]| [x[0] * x[0] + 1.0, x[1] * x[1], x[2] * x[2] + 1e-9];
        let found = find(&[0.1, 0.1, 0.1], &[1.0; 3], 1.0, misses);
        assert!(found.at[0].is_nan() && found.at[2].is_nan());
        assert!(found.at[1].abs() < 1e-6);
    }
}
