//! Curves of a sweep as Béziers, fitted within a tolerance (kurbo; R. Levien, *Parallel curves of cubic
//! Béziers*, 2022).

use std::cell::RefCell;
use std::f64::consts::PI;
use std::ops::Range;

use kurbo::{BezPath, CurveFitSample, ParamCurveFit, Point, Vec2, fit_to_bezpath};

use super::{Stretch, Sweep};
use crate::board::{Moving, Place};

/// A point of the page and how it moves with the input; `None` where the numbers have none.
pub type Track<'t> = dyn Fn(f64, &[Option<Moving>]) -> Option<(Point, Vec2)> + 't;

/// A stretch as a curve over 0 … 1. The input runs as a cosine, slowly near both ends: at a limit everything
/// goes as the root of what is left, and becomes smooth by that.
struct Course<'s> {
    sweep: &'s Sweep,
    stretch: &'s Stretch,
    range: [f64; 2],
    track: &'s Track<'s>,
    room: RefCell<(Place, Point)>,
}

impl Course<'_> {
    fn at(&self, t: f64) -> (Point, Vec2) {
        /// The very ends have no finite derivative at a limit.
        const END: f64 = 1e-6;
        let t = t.clamp(END, 1.0 - END);
        let [from, to] = self.range;
        let (sin, cos) = libm::sincos(PI * t);
        let input = f64::midpoint(from, to) - (to - from) / 2.0 * cos;
        let speed = (to - from) / 2.0 * PI * sin;
        let mut room = self.room.borrow_mut();
        let values = self.sweep.look(input, &self.stretch.signs, &mut room.0);
        match (self.track)(input, &values) {
            Some((p, d)) if p.is_finite() && d.is_finite() => {
                room.1 = p;
                (p, d * speed)
            }
            // Beside a place without a number the curve stands where it was.
            _ => (room.1, Vec2::ZERO),
        }
    }
}

impl ParamCurveFit for Course<'_> {
    fn sample_pt_tangent(&self, t: f64, sign: f64) -> CurveFitSample {
        let (p, tangent) = self.at(t);
        if tangent.hypot2() > 0.0 {
            return CurveFitSample { p, tangent };
        }
        // A cusp: the direction in which it is left or reached.
        let near = self.at((t + sign * 1e-4).clamp(0.0, 1.0)).0;
        CurveFitSample { p, tangent: (near - p) * sign.signum() }
    }

    fn sample_pt_deriv(&self, t: f64) -> (Point, Vec2) {
        self.at(t)
    }

    fn break_cusp(&self, range: Range<f64>) -> Option<f64> {
        /// Between two looks a curve that turns by more than this has a corner.
        const CORNER: f64 = -0.5;
        const LOOKS: u32 = 16;
        const HALVINGS: u32 = 40;
        let step = (range.end - range.start) / f64::from(LOOKS);
        if step < 1e-6 {
            return None;
        }
        let mut last = self.at(range.start).1;
        for i in 1..=LOOKS {
            let t = range.start + step * f64::from(i);
            let now = self.at(t).1;
            if last.dot(now) < CORNER * last.hypot() * now.hypot() && i < LOOKS {
                // Halved down to the corner itself, or a hook would stick out of the curve.
                let (mut low, mut high) = (t - step, t);
                for _ in 0..HALVINGS {
                    let middle = f64::midpoint(low, high);
                    if self.at(middle).1.dot(last) > 0.0 { low = middle } else { high = middle }
                }
                return Some(low);
            }
            last = now;
        }
        None
    }
}

impl Sweep {
    /// The curve that a track draws in one stretch, or in a part of it, within `accuracy` of the page.
    #[must_use]
    pub fn curve(&self, stretch: &Stretch, range: [f64; 2], track: &Track<'_>, accuracy: f64) -> BezPath {
        let room = RefCell::new((Place::default(), Point::ZERO));
        let course = Course { sweep: self, stretch, range, track, room };
        fit_to_bezpath(&course, accuracy)
    }
}
