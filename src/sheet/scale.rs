//! Round scales: 1, 2, 2.5, 5 × 10ⁿ.

use crate::graphical::{Extents, Scales};
use crate::scene::Scene;

/// The round steps within a decade.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// Largest size of the geometry of a panel on an A4 sheet, width and height in mm, without labels and
/// symbols.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PanelSizes {
    /// The skeleton; the result table stands beside it.
    pub skeleton: (f64, f64),
    /// A polygon.
    pub polygon: (f64, f64),
}

/// The room for the panels: two polygons share a row, a single one has it to itself.
#[must_use]
pub const fn panel_sizes(two_polygons: bool) -> PanelSizes {
    let polygon = if two_polygons { (73.0, 64.0) } else { (150.0, 75.0) };
    PanelSizes { skeleton: (92.0, 70.0), polygon }
}

/// The scales of a scene: those that it states, else round ones by which the diagrams fill their panels.
#[must_use]
pub fn for_scene(scene: &Scene, extents: Extents) -> Scales {
    let drawn = |[w, h]: [f64; 2]| w > 0.0 || h > 0.0;
    let sizes = panel_sizes(drawn(extents.velocity) && drawn(extents.acceleration));
    let length = scene.units.length.si;
    let time = scene.units.time.si;
    let polygon = |[w, h]: [f64; 2], unit: f64| choose_for(w, h, sizes.polygon, unit).unwrap_or(unit);
    let [w, h] = extents.space;
    let stated = &scene.sheet;
    Scales {
        length: stated
            .length_scale
            .map(|ratio| ratio / 1000.0)
            .or_else(|| choose_length(w, h, sizes.skeleton))
            .unwrap_or(0.001),
        velocity: stated.velocity_scale.unwrap_or_else(|| polygon(extents.velocity, length / time)),
        acceleration: stated
            .acceleration_scale
            .unwrap_or_else(|| polygon(extents.acceleration, length / (time * time))),
    }
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

/// `step × 10^exponent`, correctly rounded: decimal text is.
fn shifted(step: f64, exponent: i32) -> f64 {
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
