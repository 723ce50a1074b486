//! The equations with their slopes, without a record: what the search for assemblies iterates on.
//!
//! A pair binds two bodies, so an equation of the position depends on at most six coordinates: a number carries
//! its derivatives by these six beside it (Wengert 1964). No rounding is tracked; what the search has found
//! is finished and judged on the record.

use std::cell::Cell;
use std::ops::{Add, Div, Mul, Neg, Sub};

use super::constraints::{Drive, Formulas, Num, Param, Row, Site};
use super::tape::Calculus;

/// Coordinates on which one equation may hang: x, y, θ of two bodies.
pub(super) const MOST: usize = 6;

/// A number with its derivatives.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slope {
    /// The number.
    pub(super) value: f64,
    /// Its derivatives by the coordinates of [`Here::bodies`], three for each.
    pub(super) by: [f64; MOST],
}

impl Slope {
    /// The coordinates on which an equation, whose slope this is, hangs here.
    pub(super) fn columns(self, row: &Row) -> impl Iterator<Item = usize> {
        self.columns_and_slopes(row).map(|(column, _)| column)
    }

    /// The same with the slopes.
    pub(super) fn columns_and_slopes(self, row: &Row) -> impl Iterator<Item = (usize, f64)> {
        let [first, second] = row.bodies();
        let most = if first == second { MOST / 2 } else { MOST };
        let column = move |k: usize| 3 * if k < 3 { first } else { second } + k % 3;
        (0..most).filter(move |k| self.by[*k] != 0.0).map(move |k| (column(k), self.by[k]))
    }

    /// `value`, changing as `factor` times this number and `other_factor` times the other.
    fn blend(self, value: f64, factor: f64, other: Self, other_factor: f64) -> Self {
        let mut by = self.by;
        for (to, from) in by.iter_mut().zip(other.by) {
            *to = *to * factor + from * other_factor;
        }
        Self { value, by }
    }

    fn through(self, value: f64, factor: f64) -> Self {
        Self { value, by: self.by.map(|d| d * factor) }
    }
}

impl Add for Slope {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.blend(self.value + other.value, 1.0, other, 1.0)
    }
}

impl Sub for Slope {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.blend(self.value - other.value, 1.0, other, -1.0)
    }
}

impl Neg for Slope {
    type Output = Self;
    fn neg(self) -> Self {
        self.through(-self.value, -1.0)
    }
}

impl Mul for Slope {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.blend(self.value * other.value, other.value, other, self.value)
    }
}

impl Div for Slope {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.value / other.value;
        self.blend(quotient, 1.0 / other.value, other, -quotient / other.value)
    }
}

impl Calculus for Slope {
    fn value(self) -> f64 {
        self.value
    }

    fn cos_sin(self) -> [Self; 2] {
        let (sin, cos) = libm::sincos(self.value);
        [self.through(cos, -sin), self.through(sin, cos)]
    }

    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        self.through(root, 0.5 / root)
    }

    fn atan2(self, x: Self) -> Self {
        let square = self.value * self.value + x.value * x.value;
        self.blend(libm::atan2(self.value, x.value), x.value / square, x, -self.value / square)
    }

    fn wrapped(self) -> Self {
        let turns = (self.value / std::f64::consts::TAU - 0.5).ceil();
        Self { value: self.value - turns * std::f64::consts::TAU, ..self }
    }
}

/// How far each body has turned when it was last asked for: its angle, with its sine and cosine. Every equation of a body
/// asks for them again.
#[derive(Debug)]
pub(super) struct Turns(Vec<Cell<[f64; 3]>>);

impl Turns {
    /// Of so many bodies, of which none was asked for.
    pub(super) fn new(bodies: usize) -> Self {
        Self(vec![Cell::new([f64::NAN; 3]); bodies])
    }

    /// Sine and cosine of a body's angle.
    fn sincos(&self, body: usize, angle: f64) -> (f64, f64) {
        let Some(known) = self.0.get(body) else { return libm::sincos(angle) };
        let [of, sin, cos] = known.get();
        if of == angle && angle != 0.0 {
            return (sin, cos);
        }
        let (sin, cos) = libm::sincos(angle);
        known.set([angle, sin, cos]);
        (sin, cos)
    }
}

/// A place of all bodies.
#[derive(Debug)]
pub(super) struct Here<'a> {
    pose: &'a [f64],
    params: &'a [Param],
    turns: &'a Turns,
    bodies: [usize; 2],
    /// The equation has asked for a body besides the two.
    strange: Cell<bool>,
}

impl<'a> Here<'a> {
    /// An equation at a place: its value and its derivatives by the coordinates of [`Row::bodies`], three for each
    /// (the first body's alone where both are one). `None` where it has no value here, or binds a third body.
    pub(super) fn evaluate(
        row: &Row,
        pose: &'a [f64],
        params: &'a [Param],
        turns: &'a Turns,
    ) -> Option<Slope> {
        let here = Self { pose, params, turns, bodies: row.bodies(), strange: Cell::new(false) };
        let slope = here.row(row);
        let sound = slope.value.is_finite() && slope.by.iter().all(|d| d.is_finite());
        (sound && !here.strange.get()).then_some(slope)
    }
}

impl Formulas for Here<'_> {
    type Number = Slope;

    fn num(&self, num: Num) -> Slope {
        self.exact(match num {
            Num::Exact(value) => value,
            Num::Param(index) => self.params[index].value,
        })
    }

    fn exact(&self, value: f64) -> Slope {
        Slope { value, by: [0.0; MOST] }
    }

    fn coordinate(&self, body: usize, axis: usize) -> Slope {
        if body == 0 {
            return self.exact(0.0);
        }
        let mut slope = self.exact(self.pose[3 * body + axis]);
        match self.bodies.iter().position(|b| *b == body) {
            Some(index) => slope.by[3 * index + axis] = 1.0,
            None => self.strange.set(true),
        }
        slope
    }

    fn drive(&self, drive: &Drive) -> Slope {
        self.num(drive.value)
    }

    fn site_along(&self, site: &Site, axis: usize) -> Slope {
        if site.body == 0 {
            return self.num(site.own[axis]);
        }
        let origin = self.coordinate(site.body, axis);
        if site.own == [Num::Exact(0.0); 2] {
            return origin;
        }
        origin + self.carried_vector(site.body, site.own)[axis]
    }

    /// The slope of a turned vector by its angle is the vector a quarter turn on.
    fn carried_vector(&self, body: usize, own: [Num; 2]) -> [Slope; 2] {
        let angle = self.angle(body);
        let (sin, cos) = self.turns.sincos(body, angle.value);
        let [a, b] = self.pair(own).map(|own| own.value);
        let (x, y) = (cos * a - sin * b, sin * a + cos * b);
        [angle.through(x, -y), angle.through(y, x)]
    }
}
