//! Where a sweep has carried the points of wheels, against how these roll.
//!
//! At one position the independent solver cannot tell where the points of a wheel stand, only how they move if they stand
//! there. So they are followed: they begin where the scene has them; on the way no place leaps; and at every position that is
//! compared each of them moves by the input as the independent solver has it move.

use crate::analytic;
use crate::board::Dual;
use crate::mechanism::Mechanism;
use crate::mechanism::quantity::{Answer, Quantity};
use crate::sweep::{Skeleton, Stretch, Sweep};

use super::sweep::SweepUnconfirmed;

/// Where the sweep looks so often, places are followed from one look to the next, and once in between.
const SPARSER: f64 = 16.0;

/// What is left of a place when it has been followed for a while, in sizes of the mechanism (of an angle, in radians).
const SMOOTH: f64 = 1e-6;

/// A change by more than this part over no way at all is a leap; less is what a root at a limit leaves.
const LEAP: f64 = 1e-3;

/// An interval over which it strays is halved so often before it leaps there: what ends in a limit goes as a root, and is
/// smooth to [`SMOOTH`] by then.
const MOST_HALVINGS: u32 = 48;

/// An error of a sweep is an estimate: a place, and what its slope promises, is known within so many of them.
const ERRORS: f64 = 64.0;

/// Along one stretch an interval is halved so often at most: more often only where rounding says nothing.
const ALL_HALVINGS: u32 = 4096;

/// So much of the fastest velocity may be lost in a derivative.
const LOST: f64 = 1e-6;

/// A sweep does not carry the points of wheels along as these roll.
#[derive(Debug, Clone, PartialEq)]
pub struct CarriedAstray {
    /// What, as a scene names it: the place of a point, or the angle of a wheel.
    pub name: String,
    /// Where, SI units.
    pub at: f64,
    /// By how much it leaps, or moves for each unit of what is varied, by the sweep; SI units.
    pub swept: f64,
    /// The same by the independent solver; 0 where it leaps.
    pub analytic: f64,
    /// Whether it leaps.
    pub leaps: bool,
}

/// A number of a skeleton: its name is told only where it is wrong.
#[derive(Clone, Copy)]
struct Followed {
    value: f64,
    slope: f64,
    /// How far the value may be off by rounding: much, where lines that find it are one for a moment.
    error: f64,
    size: f64,
}

/// The numbers of a skeleton, always in one order.
fn followed(skeleton: &Skeleton, size: f64) -> Vec<Followed> {
    let places = skeleton.points.iter().flat_map(|(_, at)| at.map(|m| (m, size)));
    let angles = skeleton.turned.iter().map(|(_, by)| (*by, 1.0));
    let followed = |(m, size): (Dual, f64)| {
        let error = if m.error.is_finite() { ERRORS * m.error } else { 0.0 };
        Followed { value: m.value, slope: m.slope, error, size }
    };
    places.chain(angles).map(followed).collect()
}

fn name_of(mechanism: &Mechanism, skeleton: &Skeleton, index: usize) -> String {
    match skeleton.points.get(index / 2) {
        Some((point, _)) => Quantity::Position(*point).name(mechanism),
        None => match skeleton.turned.get(index - 2 * skeleton.points.len()) {
            Some((wheel, _)) => Quantity::Angle(*wheel).name(mechanism),
            None => String::new(),
        },
    }
}

/// Half the way across everything that is drawn.
fn size_of(skeleton: &Skeleton) -> f64 {
    let across = |axis: usize| {
        let values = skeleton.points.iter().map(|(_, at)| at[axis].value).filter(|value| value.is_finite());
        let (least, most) =
            values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), value| (a.min(value), b.max(value)));
        if least < most { most - least } else { 0.0 }
    };
    0.5 * libm::hypot(across(0), across(1))
}

/// Follows all places along the stretches that are reached without taking the mechanism apart.
pub(super) fn nothing_leaps(sweep: &Sweep) -> Result<(), SweepUnconfirmed> {
    let Some(mechanism) = &sweep.marked_at(sweep.start) else { return Ok(()) };
    let mut before: Option<&Stretch> = None;
    for stretch in sweep.stretches.iter().filter(|stretch| !stretch.apart) {
        if let Some(before) = before
            && before.to == stretch.from
        {
            seam(sweep, mechanism, [before, stretch])?;
        }
        along(sweep, mechanism, stretch)?;
        before = Some(stretch);
    }
    Ok(())
}

/// Where one stretch goes on from another all places are the same.
fn seam(
    sweep: &Sweep,
    mechanism: &Mechanism,
    [before, after]: [&Stretch; 2],
) -> Result<(), SweepUnconfirmed> {
    let at = after.from;
    let (last, first) = (sweep.skeleton_in(before, at), sweep.skeleton_in(after, at));
    let size = size_of(&first);
    for (index, (a, b)) in followed(&last, size).iter().zip(&followed(&first, size)).enumerate() {
        let by = b.value - a.value;
        if by.abs() > SMOOTH * a.size + a.error + b.error {
            let name = name_of(mechanism, &first, index);
            let astray = CarriedAstray { name, at, swept: by, analytic: 0.0, leaps: true };
            return Err(SweepUnconfirmed::Carried(astray));
        }
    }
    Ok(())
}

/// Follows all places along one stretch, from look to look.
fn along(sweep: &Sweep, mechanism: &Mechanism, stretch: &Stretch) -> Result<(), SweepUnconfirmed> {
    let way = stretch.to - stretch.from;
    let whole = sweep.range[1] - sweep.range[0];
    let parts = libm::ceil(f64::from(sweep.looks()) / SPARSER * way / whole).max(4.0);
    let begins = sweep.skeleton_in(stretch, f64::midpoint(stretch.from, stretch.to));
    let size = size_of(&begins);
    let look = |at: f64| (at, followed(&sweep.skeleton_in(stretch, at), size));
    let (mut from, mut part) = (look(stretch.from), 1.0);
    let mut all = ALL_HALVINGS;
    while part <= parts {
        let to = look(if part < parts { stretch.from + way * (part / parts) } else { stretch.to });
        let middle = look(f64::midpoint(from.0, to.0));
        if let Some((at, by, index)) = leap(&look, [&from, &middle, &to], (MOST_HALVINGS, &mut all)) {
            let name = name_of(mechanism, &begins, index);
            let astray = CarriedAstray { name, at, swept: by, analytic: 0.0, leaps: true };
            return Err(SweepUnconfirmed::Carried(astray));
        }
        (from, part) = (to, part + 1.0);
    }
    Ok(())
}

type Look = (f64, Vec<Followed>);

/// Where a number leaps between two places, by how much, and which: its change is not what its slopes come to (Simpson's
/// rule), however near together they are taken.
fn leap(
    look: &impl Fn(f64) -> Look,
    [from, middle, to]: [&Look; 3],
    (left, all): (u32, &mut u32),
) -> Option<(f64, f64, usize)> {
    let way = to.0 - from.0;
    let astray = from.1.iter().zip(&middle.1).zip(&to.1).enumerate().find_map(|(index, ((a, m), b))| {
        let by = b.value - a.value;
        let expected = way / 6.0 * (a.slope + 4.0 * m.slope + b.slope);
        // Where there are no numbers the chain does not close.
        let within = SMOOTH * a.size + a.error + m.error + b.error;
        ((by - expected).abs() > within).then_some((by, index))
    });
    let (by, index) = astray?;
    if left == 0 || middle.0 <= from.0 || middle.0 >= to.0 {
        let rounding = from.1[index].error + to.1[index].error;
        return (by.abs() > LEAP * from.1[index].size + rounding).then_some((from.0, by, index));
    }
    if *all == 0 {
        return None;
    }
    *all -= 1;
    for [from, to] in [[from, middle], [middle, to]] {
        let middle = look(f64::midpoint(from.0, to.0));
        let found = leap(look, [from, &middle, to], (left - 1, &mut *all));
        if found.is_some() {
            return found;
        }
    }
    None
}

/// Whether everything moves by the input at one place as the independent solver has it move from there.
pub(super) fn moves_as_it_rolls(sweep: &Sweep, at: f64) -> Result<(), SweepUnconfirmed> {
    let (Some(mechanism), Some(stretch)) = (sweep.led_at(at), sweep.stretch_at(at)) else { return Ok(()) };
    let skeleton = sweep.skeleton_in(stretch, at);
    let rates: Vec<([f64; 2], Quantity)> = skeleton
        .points
        .iter()
        .map(|(point, at)| (at.map(|m| m.slope), Quantity::Velocity(*point)))
        .chain(skeleton.turned.iter().map(|(wheel, by)| ([by.slope, 0.0], Quantity::Omega(*wheel))))
        .collect();
    let quantities: Vec<Quantity> = rates.iter().map(|(_, quantity)| *quantity).collect();
    let state =
        analytic::solve_for(&mechanism, &quantities).map_err(|why| SweepUnconfirmed::Refused { at, why })?;
    // Not determined there: the sweep has no number of it, or one that says so by its error.
    let answers: Vec<Option<([f64; 2], f64)>> = quantities
        .iter()
        .map(|quantity| match state.answer(quantity) {
            Answer::Vector { value, bound } => Some((value, bound)),
            Answer::Scalar { value, bound } => Some(([value, 0.0], bound)),
            _ => None,
        })
        .collect();
    let of_point = |quantity: &Quantity| matches!(quantity, Quantity::Velocity(_));
    let fastest = |of_points: bool| {
        let all = quantities.iter().zip(&answers).filter(|(quantity, _)| of_point(quantity) == of_points);
        all.filter_map(|(_, answer)| *answer).map(|([x, y], _)| libm::hypot(x, y)).fold(0.0, f64::max)
    };
    let [turning, moving] = [false, true].map(fastest);
    // A wheel that stands still for a moment turns by what its points are off.
    let size = size_of(&skeleton);
    let by_points = if size > 0.0 { moving / size } else { 0.0 };
    let fastest = [turning.max(by_points), moving];
    for ((swept, quantity), answer) in rates.iter().zip(&answers) {
        let Some((value, bound)) = answer else { continue };
        let apart = libm::hypot(swept[0] - value[0], swept[1] - value[1]);
        // Written so that a not-a-number is not confirmed.
        let confirmed = apart <= bound + LOST * fastest[usize::from(of_point(quantity))];
        if !confirmed {
            let place = match *quantity {
                Quantity::Velocity(point) => Quantity::Position(point),
                Quantity::Omega(wheel) => Quantity::Angle(wheel),
                other => other,
            };
            let name = place.name(&mechanism);
            let [swept, analytic] = [*swept, *value].map(|[x, y]| libm::hypot(x, y));
            return Err(SweepUnconfirmed::Carried(CarriedAstray { name, at, swept, analytic, leaps: false }));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::super::sweep::{SweepUnconfirmed, confirm_sweep};
    use crate::mechanism::{Given, Mechanism, Path, Roll};
    use crate::sweep::Sweep;

    /// A gear that carries a pin.
    const GEAR: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [50, 0] },
        "placed": { "A": [0, 15], "P": [50, 22] },
        "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4", "P"] } },
        "rolls": [ { "links": [2, 4], "centres": ["O2", "O4"], "radii": [20, 30] } ],
        "input": { "link": 2, "omega": 1 }, "find": ["x(P)"] }"#;

    fn swept(text: &str) -> Sweep {
        let scene = crate::scene::read(text, "wheels.json").unwrap_or_else(|error| panic!("{error}"));
        Sweep::new(&scene.mechanism, None).unwrap_or_else(|error| panic!("{error}"))
    }

    /// By other radii, which keep their distance, a wheel rolls otherwise.
    fn other_radii(mechanism: &mut Mechanism) {
        for roll in &mut mechanism.rolls {
            if let Roll::Circles { radii: [first, second], .. } = roll {
                let less = 1e-3 * first.value;
                (*first, *second) = (Given::exact(first.value - less), Given::exact(second.value + less));
            }
        }
    }

    fn is_astray(sweep: &Sweep) -> bool {
        matches!(confirm_sweep(sweep), Err(SweepUnconfirmed::Carried(_) | SweepUnconfirmed::Number(_)))
    }

    /// With nothing asked but the place of the gear's pin, the other solver is told where it stands,
    /// and only how it got there tells that the ratio is another.
    #[test]
    fn a_wheel_that_rolls_by_another_ratio_is_found() {
        let sweep = swept(GEAR);
        assert!(sweep.is_carried_along());
        assert!(confirm_sweep(&sweep).is_ok_and(|positions| positions > 4), "{:?}", confirm_sweep(&sweep));
        assert!(is_astray(&sweep.beside(other_radii)));
    }

    /// Its only wheel stands still where crank and rod lie in one line, which rounding does not tell from turning a little.
    #[test]
    fn a_wheel_that_stands_still_is_confirmed() {
        for own in [0, 65, 90] {
            let text = r#"{ "units": { "length": "cm" }, "fixed": { "O": [0, 0] },
                "links": { "2": { "joins": ["O", "A"], "length": 5 }, "3": { "joins": ["A", "C"], "length": 18 },
                           "4": { "joins": ["C"] } },
                "rolls": [{ "links": [1, 4], "line": { "link": 1, "through": [0, -4], "angle": 0 }, "centre": "C", "radius": 4 }],
                "near": { "C": [20, 0] }, "input": { "link": 2, "angle": OWN, "omega": "120 rpm ccw" },
                "find": ["v(C)", "omega(4)", "a(C)", "alpha(4)", "x(C)", "x(A)"] }"#;
            let sweep = swept(&text.replace("OWN", &own.to_string()));
            for at in [0.0, std::f64::consts::PI] {
                let still = super::moves_as_it_rolls(&sweep, at);
                assert!(still.is_ok(), "from {own} at {at}: {still:?}");
            }
            assert!(confirm_sweep(&sweep).is_ok(), "from {own}: {:?}", confirm_sweep(&sweep));
        }
    }

    /// A four-bar linkage without wheels, whose crank goes round.
    const FOUR_BAR: &str = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 40 }, "3": { "joins": ["A", "B"], "length": 90 },
                   "4": { "joins": ["O4", "B"], "length": 70 } },
        "near": { "B": [90, 65] }, "input": { "link": 2, "angle": 60, "omega": 10 }, "find": ["x(B)", "omega(4)"] }"#;

    /// Drawn in the other assembly all the way every place closes, and the speeds are those of that assembly: only from the
    /// scene itself it is known which is meant.
    #[test]
    fn the_other_assembly_all_the_way_is_found() {
        let mut sweep = swept(FOUR_BAR);
        assert!(confirm_sweep(&sweep).is_ok_and(|positions| positions > 4), "{:?}", confirm_sweep(&sweep));
        for stretch in &mut sweep.stretches {
            stretch.signs.iter_mut().for_each(|sign| *sign = -*sign);
        }
        assert!(confirm_sweep(&sweep).is_err());
    }

    /// A wheel of one joint turns a line on which another one rolls: by its angle alone it is known how the line lies.
    #[test]
    fn a_line_that_a_wheel_turns_by_another_ratio_is_found() {
        let text = r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [40, 0], "O7": [120, 0] },
            "placed": { "A": [0, 15], "F": [60, 40] },
            "links": { "2": { "joins": ["O2", "A"] }, "4": { "joins": ["O4"] }, "7": { "joins": ["O7", "F"] },
                       "8": { "joins": ["F"] } },
            "rolls": [ { "links": [2, 4], "centres": ["O2", "O4"], "radii": [20, 20] },
                       { "links": [4, 8], "line": { "link": 4, "through": "O4", "offset": 30 }, "centre": "F",
                         "radius": 10 } ],
            "input": { "link": 2, "omega": 1 }, "find": ["omega(7)"] }"#;
        let sweep = swept(text);
        assert!(confirm_sweep(&sweep).is_ok(), "{:?}", confirm_sweep(&sweep));
        assert!(is_astray(&sweep.clone().beside(other_radii)));
        let tilted = |mechanism: &mut Mechanism| {
            for roll in &mut mechanism.rolls {
                if let Roll::Line { guide, .. } = roll
                    && let Path::Straight { turned, .. } = &mut guide.path
                {
                    *turned = Given::exact(1e-3);
                }
            }
        };
        assert!(is_astray(&sweep.beside(tilted)));
    }

    /// Where a wheel has gone on by a whole turn of what it rolls on too many, it leaps.
    #[test]
    fn a_turn_too_many_is_found() {
        let mut sweep = swept(GEAR);
        let start = sweep.start;
        let mut leaps = 0;
        for index in 0..sweep.stretches.len() {
            let stretch = &sweep.stretches[index];
            if (stretch.from..=stretch.to).contains(&start) {
                continue;
            }
            let signs = stretch.signs.clone();
            for sign in 0..signs.len() {
                sweep.stretches[index].signs[sign] += 2.0;
                leaps += usize::from(is_astray(&sweep));
                sweep.stretches[index].signs.clone_from(&signs);
            }
        }
        assert!(leaps > 0, "{:?}", sweep.stretches);
    }
}
