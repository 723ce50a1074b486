//! Vectors of the plane, and the one generator of random numbers.

use std::ops::{Add, Mul, Neg, Sub};

/// A vector or a place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Xy {
    pub(crate) x: f64,
    pub(crate) y: f64,
}

pub(crate) const O: Xy = xy(0.0, 0.0);

pub(crate) const fn xy(x: f64, y: f64) -> Xy {
    Xy { x, y }
}

impl Add for Xy {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        xy(self.x + b.x, self.y + b.y)
    }
}

impl Sub for Xy {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        xy(self.x - b.x, self.y - b.y)
    }
}

impl Neg for Xy {
    type Output = Self;
    fn neg(self) -> Self {
        xy(-self.x, -self.y)
    }
}

impl Mul<f64> for Xy {
    type Output = Self;
    fn mul(self, by: f64) -> Self {
        xy(self.x * by, self.y * by)
    }
}

impl Xy {
    pub(crate) fn polar(length: f64, angle: f64) -> Self {
        xy(length * angle.cos(), length * angle.sin())
    }

    pub(crate) fn size(self) -> f64 {
        self.x.hypot(self.y)
    }

    pub(crate) fn unit(self) -> Self {
        self * (1.0 / self.size())
    }

    /// A quarter turn counter-clockwise.
    pub(crate) fn left(self) -> Self {
        xy(-self.y, self.x)
    }

    pub(crate) fn dot(self, b: Self) -> f64 {
        self.x * b.x + self.y * b.y
    }

    pub(crate) fn cross(self, b: Self) -> f64 {
        self.x * b.y - self.y * b.x
    }

    /// Product as complex numbers: turned and stretched.
    pub(crate) fn times(self, b: Self) -> Self {
        xy(self.x * b.x - self.y * b.y, self.x * b.y + self.y * b.x)
    }

    pub(crate) fn turned(self, angle: f64) -> Self {
        self.times(Self::polar(1.0, angle))
    }

    pub(crate) fn mirrored(self) -> Self {
        xy(self.x, -self.y)
    }

    /// Angle from +x in degrees.
    pub(crate) fn degrees(self) -> f64 {
        self.y.atan2(self.x).to_degrees()
    }
}

/// Where the line through `p` along `d` meets the line through `q` along `e`; none where they cross flatter than 20°:
/// no pencil finds that point, and a mistake that leads there is found by its maker.
pub(crate) fn meet(p: Xy, d: Xy, q: Xy, e: Xy) -> Option<Xy> {
    let sine = d.unit().cross(e.unit());
    (sine.abs() > 0.34).then(|| p + d * ((q - p).cross(e) / d.cross(e)))
}

/// Third corner of the triangle with sides `from_a` and `from_b` over `a` and `b`, to the left of a→b for +1.
pub(crate) fn corner(a: Xy, b: Xy, from_a: f64, from_b: f64, side: f64) -> Option<Xy> {
    let base = (b - a).size();
    let along = (base * base + from_a * from_a - from_b * from_b) / (2.0 * base);
    let height = from_a * from_a - along * along;
    let u = (b - a).unit();
    (height > 0.0).then(|| a + u * along + u.left() * (side * height.sqrt()))
}

/// `SplitMix64`.
#[derive(Debug, Clone)]
pub(crate) struct Chance(u64);

impl Chance {
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed ^ 0x5851_F42D_4C95_7F2D)
    }

    pub(crate) fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^ (z >> 31)
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        #[allow(clippy::cast_precision_loss, reason = "53 bits fit")]
        let part = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * part
    }

    pub(crate) fn coin(&mut self) -> bool {
        self.bits() >> 63 == 1
    }

    pub(crate) fn sign(&mut self) -> f64 {
        if self.coin() { 1.0 } else { -1.0 }
    }

    pub(crate) fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[usize::try_from(self.bits() % u64::try_from(from.len()).unwrap()).unwrap()]
    }

    /// A place anywhere in a disc.
    pub(crate) fn disc(&mut self, radius: f64) -> Xy {
        let far = radius * self.between(0.0, 1.0).sqrt();
        Xy::polar(far, self.between(0.0, std::f64::consts::TAU))
    }
}
