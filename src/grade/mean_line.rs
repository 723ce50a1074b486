//! A turning-moment diagram cut at another height than that of its mean: crossings, areas and levels as they follow from
//! a student's own mean torque on the given curve.

use crate::graphical::cycle::CycleSheet;
use crate::mechanism::cycle::CycleQuantity;

/// What is found along one mean line, in the order of the motion from angle 0.
pub(super) struct Cut {
    /// Angles of the input, radians.
    crossings: Vec<f64>,
    /// From each crossing to the next, J.
    areas: Vec<f64>,
    /// At each crossing, J.
    levels: Vec<f64>,
}

impl Cut {
    /// Cuts the curve that is given; `None` where there is no mean line, or it meets nothing.
    pub(super) fn new(sheet: &CycleSheet, mean: f64) -> Option<Self> {
        let line = sheet.constant?;
        // What drives counts upwards.
        let sign = if line == 0 { -1.0 } else { 1.0 };
        let period = sheet.period;
        let turned = |at: f64| if sheet.falling { period - at } else { at };
        let mut above: Vec<[f64; 2]> =
            sheet.curves[1 - line].iter().map(|&[at, torque]| [turned(at), sign * (torque - mean)]).collect();
        if sheet.falling {
            above.reverse();
        }
        let (mut crossings, mut levels, mut energy) = (Vec::new(), Vec::new(), 0.0);
        for ends in above.windows(2) {
            let [[from, before], [to, after]] = [ends[0], ends[1]];
            let rises = before <= 0.0 && after > 0.0;
            let falls = before >= 0.0 && after < 0.0;
            if rises || falls {
                let far = (to - from) * before / (before - after);
                let angle = from + far;
                crossings.push(if sheet.falling && angle > 0.0 { period - angle } else { angle });
                levels.push(energy + before * far / 2.0);
            }
            energy += (before + after) / 2.0 * (to - from);
        }
        let next = levels.iter().skip(1).copied().chain(levels.first().map(|first| energy + first));
        let areas = levels.iter().zip(next).map(|(level, next)| next - level).collect();
        (crossings.len() > 1).then_some(Self { crossings, areas, levels })
    }

    /// A number of the diagram; `None` of what does not hang on the mean line alone.
    pub(super) fn number(&self, of: CycleQuantity) -> Option<f64> {
        let numbered = |k: u32, of: &[f64]| of.get((k as usize).checked_sub(1)?).copied();
        let extreme = |sign: f64| {
            let all = (0..self.levels.len()).max_by(|a, b| {
                let [a, b] = [a, b].map(|place| sign * self.levels[*place]);
                a.total_cmp(&b)
            });
            all.unwrap_or(0)
        };
        match of {
            CycleQuantity::Crossing(k) => numbered(k, &self.crossings),
            CycleQuantity::Area(k) => numbered(k, &self.areas),
            CycleQuantity::Level(k) => numbered(k, &self.levels),
            CycleQuantity::Highest => Some(self.levels[extreme(1.0)]),
            CycleQuantity::Lowest => Some(self.levels[extreme(-1.0)]),
            CycleQuantity::AtHighest => Some(self.crossings[extreme(1.0)]),
            CycleQuantity::AtLowest => Some(self.crossings[extreme(-1.0)]),
            CycleQuantity::Fluctuation => Some(self.levels[extreme(1.0)] - self.levels[extreme(-1.0)]),
            _ => None,
        }
    }
}
