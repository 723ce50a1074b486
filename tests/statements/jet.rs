//! Numbers that carry their first and second rate: what a constraint says of positions, it says of velocities and
//! accelerations too.

use std::ops::{Add, Mul, Neg, Sub};

/// A value with its first and second derivative by time.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) rate: f64,
    pub(crate) second: f64,
}

impl Jet {
    pub(crate) fn new(value: f64, rate: f64, second: f64) -> Self {
        Self { value, rate, second }
    }

    pub(crate) fn constant(value: f64) -> Self {
        Self::new(value, 0.0, 0.0)
    }

    pub(crate) fn cos_sin(self) -> (Self, Self) {
        let (sin, cos) = libm::sincos(self.value);
        let (w, e) = (self.rate, self.second);
        (Self::new(cos, -sin * w, -sin * e - cos * w * w), Self::new(sin, cos * w, cos * e - sin * w * w))
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self::new(self.value + o.value, self.rate + o.rate, self.second + o.second)
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        Self::new(self.value - o.value, self.rate - o.rate, self.second - o.second)
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self::new(-self.value, -self.rate, -self.second)
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self::new(
            self.value * o.value,
            self.rate * o.value + self.value * o.rate,
            self.second * o.value + 2.0 * self.rate * o.rate + self.value * o.second,
        )
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, k: f64) -> Self {
        Self::new(self.value * k, self.rate * k, self.second * k)
    }
}

/// A moving place or direction.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moving {
    pub(crate) x: Jet,
    pub(crate) y: Jet,
}

impl Moving {
    pub(crate) fn at_rest(at: [f64; 2]) -> Self {
        Self { x: Jet::constant(at[0]), y: Jet::constant(at[1]) }
    }

    pub(crate) fn minus(self, o: Self) -> Self {
        Self { x: self.x - o.x, y: self.y - o.y }
    }

    pub(crate) fn dot(self, o: Self) -> Jet {
        self.x * o.x + self.y * o.y
    }

    pub(crate) fn cross(self, o: Self) -> Jet {
        self.x * o.y - self.y * o.x
    }

    /// How far this has turned from a direction at rest, less than half a turn.
    pub(crate) fn turned_from(self, start: [f64; 2]) -> Jet {
        let start = Self::at_rest(start);
        let (c, s) = (start.dot(self), start.cross(self));
        let square = c.value * c.value + s.value * s.value;
        let rate = (c.value * s.rate - s.value * c.rate) / square;
        let change = 2.0 * (c.value * c.rate + s.value * s.rate);
        let second = (c.value * s.second - s.value * c.second) / square - rate * change / square;
        Jet::new(libm::atan2(s.value, c.value), rate, second)
    }

    pub(crate) fn value(self) -> [f64; 2] {
        [self.x.value, self.y.value]
    }

    pub(crate) fn velocity(self) -> [f64; 2] {
        [self.x.rate, self.y.rate]
    }

    pub(crate) fn acceleration(self) -> [f64; 2] {
        [self.x.second, self.y.second]
    }
}
