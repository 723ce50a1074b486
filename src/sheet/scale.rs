//! Round scales: 1, 2, 2.5, 5 × 10ⁿ.

use crate::graphical::auxiliary::AuxiliaryDrawing;
use crate::graphical::construction::Construction;
use crate::graphical::{Extents, Scales};
use crate::mechanism::{Mechanism, PointId, Roll};
use crate::scene::Scene;

/// The round steps within a decade.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// Room for the skeleton's geometry with the result table beside it, width and height in mm.
pub const SKELETON: (f64, f64) = (92.0, 70.0);
/// Room for a long and low skeleton that has the row to itself.
pub const LONG_SKELETON: (f64, f64) = (150.0, 48.0);
/// Room for a construction on the skeleton with its named points, inside the names.
pub const AUXILIARY: (f64, f64) = (140.0, 130.0);
/// Room for a polygon that has the row to itself.
pub const POLYGON: (f64, f64) = (150.0, 78.0);
/// Room for a polygon that shares its row with another.
pub const HALF_POLYGON: (f64, f64) = (73.0, 78.0);
/// Width that two polygons side by side have, with their names, and at least for their captions.
const ROW: f64 = 168.0;
/// Width that the names beside a polygon need.
const NAMES: f64 = 13.0;
/// Width of a caption.
const CAPTION: f64 = 70.0;

/// Room for the skeleton of a question with its dimension lines, width and height in mm.
pub const QUESTION: (f64, f64) = (112.0, 96.0);

/// The scales of a question: as for a solution, but the skeleton has the row to itself.
#[must_use]
pub fn for_question(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (QUESTION.0 * wide, QUESTION.1 * high);
    let stated = scene.sheet.length_scale.map(|ratio| ratio / 1000.0);
    let length = stated.or(choose_length(w, h, free)).unwrap_or(0.001);
    Scales { length, ..for_scene(scene, extents) }
}

/// Room for a diagram beside the words of a step, width and height in mm.
pub const STEP: (f64, f64) = (66.0, 62.0);

/// The scales of a sheet that shows the steps one by one: each diagram fits beside its words.
#[must_use]
pub fn for_steps(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (STEP.0 * wide, STEP.1 * high);
    let (length, time) = (scene.units.length.si, scene.units.time.si);
    let fit = |[w, h]: [f64; 2], unit: f64| choose_for(w, h, free, unit);
    let rate = length / time;
    let stated = &scene.sheet;
    Scales {
        length: stated
            .length_scale
            .map(|ratio| ratio / 1000.0)
            .or(choose_length(w, h, free))
            .unwrap_or(0.001),
        velocity: stated.velocity_scale.or(fit(extents.velocity, rate)).unwrap_or(rate),
        acceleration: stated
            .acceleration_scale
            .or(fit(extents.acceleration, rate / time))
            .unwrap_or(rate / time),
    }
}

/// How much wider and higher than those of upright A4 the panels are.
fn stretch(scene: &Scene) -> (f64, f64) {
    let (width, height) = super::compose::paper(scene);
    let free = |side: f64, margins: f64| (side - margins).max(40.0);
    (free(width, 34.0) / 176.0, (free(height, 34.0) / 263.0).max(free(width, 34.0).min(176.0) / 176.0))
}

/// The scales of a scene: those that it states, else round ones by which the diagrams fill their panels.
#[must_use]
pub fn for_scene(scene: &Scene, extents: Extents) -> Scales {
    let length = scene.units.length.si;
    let (wide, high) = stretch(scene);
    let stretched = |room: (f64, f64)| (room.0 * wide, room.1 * high);
    let time = scene.units.time.si;
    let units = [length / time, length / (time * time)];
    let [velocity, acceleration] = polygons([extents.velocity, extents.acceleration], units, (wide, high));
    let [w, h] = with_wheels(&scene.mechanism, extents.positions, extents.rims);
    let upright = choose_length(w, h, stretched(SKELETON));
    let long = choose_length(w, h, stretched(LONG_SKELETON));
    let skeleton = upright.zip(long).map(|(a, b)| a.min(b));
    let stated = &scene.sheet;
    Scales {
        length: stated.length_scale.map(|ratio| ratio / 1000.0).or(skeleton).unwrap_or(0.001),
        velocity: stated.velocity_scale.or(velocity).unwrap_or(units[0]),
        acceleration: stated.acceleration_scale.or(acceleration).unwrap_or(units[1]),
    }
}

/// A smaller length scale, metres per millimetre, at which a construction on the skeleton finds room with all its
/// named points; `None` where it has room, or where the skeleton would become too small to read.
#[must_use]
pub fn for_auxiliary(construction: &Construction, drawing: &AuxiliaryDrawing) -> Option<f64> {
    /// The skeleton is not shrunk by more than this.
    const MOST: f64 = 4.0;
    let named = drawing.points.iter().map(|p| p.at);
    let all: Vec<[f64; 2]> = named.chain(construction.space.places.iter().flatten().copied()).collect();
    let extent = |axis: usize| {
        let least = all.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most = all.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        most - least
    };
    let needed = f64::max(extent(0) / AUXILIARY.0, extent(1) / AUXILIARY.1);
    if !(needed > 1.0 && needed <= MOST) {
        return None;
    }
    choose_length(
        extent(0) * construction.space.metres_per_mm,
        extent(1) * construction.space.metres_per_mm,
        AUXILIARY,
    )
}

/// Width and height of a skeleton with its pitch circles: those about placed centres have room in it, those about moving
/// ones may reach a little beyond it, for there is nothing to read at a rim.
fn with_wheels(mechanism: &Mechanism, [w, h]: [f64; 2], rims: [f64; 2]) -> [f64; 2] {
    const BEYOND: f64 = 1.25;
    let place = |p: PointId| mechanism.points.get(p.0)?.place.exact().map(|at| at.map(|x| x.value));
    let mut wheels: Vec<([f64; 2], f64)> = Vec::new();
    for roll in &mechanism.rolls {
        let circles = match roll {
            Roll::Circles { centres, radii, .. } => [0, 1].map(|i| (centres[i], radii[i].value)).to_vec(),
            Roll::Line { centre, radius, .. } => vec![(*centre, radius.value)],
        };
        wheels.extend(circles.into_iter().filter_map(|(centre, radius)| Some((place(centre)?, radius))));
    }
    let grown = |axis: usize, size: f64| {
        let least = wheels.iter().map(|(at, r)| at[axis] - r).fold(f64::INFINITY, f64::min);
        let most = wheels.iter().map(|(at, r)| at[axis] + r).fold(f64::NEG_INFINITY, f64::max);
        size.max(most - least).max(rims[axis] / BEYOND)
    };
    [grown(0, w), grown(1, h)]
}

/// Scales of both polygons: each fits into its half of a row, and a narrow one leaves its room to the
/// other.
fn polygons(sizes: [[f64; 2]; 2], units: [f64; 2], (wide, high): (f64, f64)) -> [Option<f64>; 2] {
    let stretched = |room: (f64, f64)| (room.0 * wide, room.1 * high);
    let fit = |i: usize, free| choose_for(sizes[i][0], sizes[i][1], free, units[i]);
    let halves = [fit(0, stretched(HALF_POLYGON)), fit(1, stretched(HALF_POLYGON))];
    let [Some(velocity), Some(acceleration)] = halves else {
        return [fit(0, stretched(POLYGON)), fit(1, stretched(POLYGON))];
    };
    let wider = |taken: f64| (ROW * wide - f64::max(taken + NAMES, CAPTION) - NAMES, POLYGON.1 * high);
    let acceleration = fit(1, wider(sizes[0][0] / velocity)).map_or(acceleration, |s| s.min(acceleration));
    let velocity = fit(0, wider(sizes[1][0] / acceleration)).map_or(velocity, |s| s.min(velocity));
    [Some(velocity), Some(acceleration)]
}

/// The smallest round number (1, 2, 2.5, 5 × 10ⁿ) that is not below `least`; `None` unless `least` is
/// positive and finite.
#[must_use]
pub fn round_up(least: f64) -> Option<f64> {
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let mut exponent = libm::floor(libm::log10(least)) as i32 - 1;
    // A product that misses the round number by its last bit must not cost a whole step.
    let enough = least * (1.0 - 1e-12);
    loop {
        for step in STEPS {
            let k = shifted(step, exponent);
            if k >= enough && k > 0.0 {
                return k.is_finite().then_some(k);
            }
        }
        exponent += 1;
        if exponent > 308 {
            return None;
        }
    }
}

/// `step × 10^exponent`, correctly rounded: decimal text is, and so is one operation on two exact numbers.
fn shifted(step: f64, exponent: i32) -> f64 {
    const POWERS: [f64; 23] = [
        1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
        1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    // Of the steps those of one and more are exact, and the powers up to the 22nd.
    if let Some(power) = POWERS.get(exponent.unsigned_abs() as usize).filter(|_| step >= 1.0) {
        return if exponent < 0 { step / power } else { step * power };
    }
    format!("{step}e{exponent}").parse().unwrap_or(0.0)
}

/// SI units per millimetre of paper such that `max_si` fits into `free_mm` and one *centimetre* of paper
/// is a round number of the scene's units; `unit_si` is how many SI units one of those is.
#[must_use]
pub fn choose(max_si: f64, free_mm: f64, unit_si: f64) -> Option<f64> {
    let per_cm = round_up(max_si / unit_si / (free_mm / 10.0))?;
    let per_mm = per_cm * unit_si / 10.0;
    (per_mm > 0.0 && per_mm.is_finite()).then_some(per_mm)
}

/// The same for what is `width_si` wide and `height_si` high and must fit into a panel.
#[must_use]
pub fn choose_for(width_si: f64, height_si: f64, free_mm: (f64, f64), unit_si: f64) -> Option<f64> {
    let tall = height_si / free_mm.1 * free_mm.0;
    choose(width_si.max(tall), free_mm.0, unit_si)
}

/// Metres per millimetre of paper such that what is `width_m` wide and `height_m` high fits into a panel
/// and the ratio is 1 : N with a round N (or N : 1 for what is smaller than its drawing).
#[must_use]
pub fn choose_length(width_m: f64, height_m: f64, free_mm: (f64, f64)) -> Option<f64> {
    let needed = (width_m / free_mm.0).max(height_m / free_mm.1) * 1000.0;
    if needed >= 1.0 {
        return Some(round_up(needed)? / 1000.0);
    }
    // Enlarged: N : 1 with the largest round N that still fits.
    let mut enlarge = round_up(1.0 / needed)?;
    if enlarge * needed > 1.0 + 1e-12 {
        let below = STEPS.iter().rev().map(|s| s / 10.0).chain(STEPS.iter().rev().copied());
        let exponent = libm::floor(libm::log10(enlarge)) as i32;
        let mut fitting = 0.0_f64;
        for step in below {
            for e in [exponent, exponent + 1] {
                let n = shifted(step, e);
                if n * needed <= 1.0 + 1e-12 {
                    fitting = fitting.max(n);
                }
            }
        }
        enlarge = fitting;
    }
    (enlarge > 0.0).then(|| 1.0 / (1000.0 * enlarge))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_round_number() {
        for (least, round) in [
            (1.0, 1.0),
            (1.01, 2.0),
            (2.0, 2.0),
            (2.1, 2.5),
            (0.3, 0.5),
            (51.0, 100.0),
            (1e-300, 1e-300),
            (7.3e17, 1e18),
        ] {
            assert_eq!(round_up(least), Some(round));
        }
        for none in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MAX] {
            assert_eq!(round_up(none), None);
        }
    }

    #[test]
    fn the_book_s_scales() {
        // Problem 3-1: V_D = 1.78 m/s fits into 40 mm at 50 cm/s ≡ 1 cm.
        let k = choose(1.782_49, 40.0, 0.01).unwrap();
        assert!((k - 0.05).abs() < 1e-15, "{k}");
        // A 525 by 581 mm mechanism fits into 105 × 66 mm at 1 : 10.
        let k = choose_length(0.525, 0.581, (105.0, 66.0)).unwrap();
        assert!((k - 0.01).abs() < 1e-15, "{k}");
        // A 3 by 2 mm mechanism is enlarged 25 : 1.
        let k = choose_length(0.003, 0.002, (105.0, 66.0)).unwrap();
        assert!((k * 1000.0 * 25.0 - 1.0).abs() < 1e-12, "{k}");
    }
}
