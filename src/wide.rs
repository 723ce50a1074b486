//! Arithmetic of 75 digits: the reference against which the board's other arithmetics are held.
//!
//! A [`Wide`] is a binary floating-point number with a significand of 256 bits and an exponent that does not
//! run over in any drawing. It is made for trust, not for speed: whole-number arithmetic on four limbs,
//! cut off instead of rounded, and series summed until their terms vanish. Division and root are Newton's
//! iterations from the double's quotient and root, with one correction by what is left.

use std::cmp::Ordering;
use std::ops::{Add, Div, Mul, Neg, Sub};

use crate::double_double::DoubleDouble;

/// Limbs of the significand, the lowest first.
type Limbs = [u64; 4];

/// The exponent that marks what is no number: a quotient by zero and all that follows from it.
const NOT_A_NUMBER: i32 = i32::MAX;

/// ± 0.m · 2^exponent, with the highest bit of m set; zero has no bit set.
#[derive(Clone, Copy, PartialEq)]
pub struct Wide {
    negative: bool,
    exponent: i32,
    limbs: Limbs,
}

impl std::fmt::Debug for Wide {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Wide({:e})", self.to_f64())
    }
}

impl Wide {
    /// Every operation errs by at most this times its result: 2⁻²⁵⁰. The four operations and the root lose
    /// a few units in the 256th bit; sine, cosine and angle lose as much absolutely, for angles of a few turns.
    pub const ROUNDOFF: f64 = 5.527_147_875_260_445e-76;

    /// Zero.
    pub const ZERO: Self = Self { negative: false, exponent: 0, limbs: [0; 4] };

    /// π, cut off.
    pub const PI: Self = Self {
        negative: false,
        exponent: 2,
        limbs: [0x020b_bea6_3b13_9b22, 0x2902_4e08_8a67_cc74, 0xc4c6_628b_80dc_1cd1, 0xc90f_daa2_2168_c234],
    };

    const INVALID: Self = Self { negative: false, exponent: NOT_A_NUMBER, limbs: [0; 4] };

    /// A double, exactly.
    #[must_use]
    pub fn of(value: f64) -> Self {
        if value == 0.0 {
            return Self::ZERO;
        }
        if !value.is_finite() {
            return Self::INVALID;
        }
        let (fraction, exponent) = libm::frexp(value.abs());
        // 0.5 ≤ fraction < 1 has at most 53 bits: whole when shifted by 64.
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole and below 2^64")]
        let top = libm::ldexp(fraction, 64) as u64;
        Self { negative: value < 0.0, exponent, limbs: [0, 0, 0, top] }
    }

    /// A double-double, exactly.
    #[must_use]
    pub fn of_double_double(value: DoubleDouble) -> Self {
        Self::of(value.hi()) + Self::of(value.lo())
    }

    fn is_zero(self) -> bool {
        self.limbs[3] == 0
    }

    fn is_number(self) -> bool {
        self.exponent != NOT_A_NUMBER
    }

    /// The number cut off to a double; not a number where it is none.
    #[must_use]
    pub fn to_f64(self) -> f64 {
        if !self.is_number() {
            return f64::NAN;
        }
        // The highest 53 bits; what is cut off is below the last place.
        #[expect(clippy::cast_precision_loss, reason = "53 bits are left")]
        let size = libm::ldexp((self.limbs[3] >> 11) as f64, self.exponent.saturating_sub(53));
        if self.negative { -size } else { size }
    }

    /// The nearest double-double, but for a unit in its last place.
    #[must_use]
    pub fn to_double_double(self) -> DoubleDouble {
        let high = self.to_f64();
        DoubleDouble::sum(high, (self - Self::of(high)).to_f64())
    }

    /// |self|.
    #[must_use]
    pub fn abs(self) -> Self {
        Self { negative: false, ..self }
    }

    /// self · 2^power.
    fn shifted(self, power: i32) -> Self {
        if self.is_zero() { self } else { Self { exponent: self.exponent.saturating_add(power), ..self } }
    }

    /// Where the limbs of a sum or product have to be moved until the highest bit is set.
    fn normal<const N: usize>(negative: bool, exponent: i32, mut limbs: [u64; N]) -> Self {
        let Some(highest) = limbs.iter().rposition(|l| *l != 0) else { return Self::ZERO };
        let whole = N - 1 - highest;
        let bits = limbs[highest].leading_zeros();
        limbs.rotate_right(whole);
        if bits > 0 {
            for i in (1..N).rev() {
                limbs[i] = limbs[i] << bits | limbs[i - 1] >> (64 - bits);
            }
            limbs[0] <<= bits;
        }
        let mut kept = [0; 4];
        kept.copy_from_slice(&limbs[N - 4..]);
        #[expect(clippy::cast_possible_truncation, clippy::cast_possible_wrap, reason = "a few hundred bits")]
        let moved = (64 * whole) as i32 + bits as i32;
        Self { negative, exponent: exponent.saturating_sub(moved), limbs: kept }
    }

    /// Which of two sizes is greater.
    fn compare_sizes(&self, other: &Self) -> Ordering {
        match (self.is_zero(), other.is_zero()) {
            (true, true) => Ordering::Equal,
            (true, false) => Ordering::Less,
            (false, true) => Ordering::Greater,
            (false, false) => {
                let limbs = || self.limbs.iter().rev().cmp(other.limbs.iter().rev());
                self.exponent.cmp(&other.exponent).then_with(limbs)
            }
        }
    }

    /// The number divided by a small whole one.
    fn over_whole(self, divisor: u64) -> Self {
        let mut quotient = [0; 5];
        let mut rest = 0_u128;
        for i in (0..5).rev() {
            let limb = if i > 0 { self.limbs[i - 1] } else { 0 };
            let part = rest << 64 | u128::from(limb);
            #[expect(clippy::cast_possible_truncation, reason = "the rest is below the divisor")]
            {
                quotient[i] = (part / u128::from(divisor)) as u64;
            }
            rest = part % u128::from(divisor);
        }
        if self.is_zero() { self } else { Self::normal(self.negative, self.exponent, quotient) }
    }

    /// The root; of a negative number, zero.
    #[must_use]
    pub fn sqrt(self) -> Self {
        if !self.is_number() || self.is_zero() || self.negative {
            return if self.is_number() { Self::ZERO } else { self };
        }
        // An even power of two apart, the size is that of a double.
        let power = self.exponent.div_euclid(2);
        let size = self.shifted(-2 * power);
        let mut inverse = Self::of(1.0 / size.to_f64().sqrt());
        // y ← y (3 − a y²) / 2 doubles the digits: 53, 106, 212.
        for _ in 0..2 {
            inverse = (inverse * (Self::of(3.0) - size * inverse * inverse)).shifted(-1);
        }
        let root = size * inverse;
        (root + ((size - root * root) * inverse).shifted(-1)).shifted(power)
    }

    /// Sine and cosine of an angle in radians.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        /// More terms than any angle below a right one needs.
        const TERMS: u64 = 80;
        let quarter = Self::PI.shifted(-1);
        let turns = (self / quarter).to_f64().round();
        if !turns.is_finite() {
            return (Self::INVALID, Self::INVALID);
        }
        let angle = self - quarter * Self::of(turns);
        let (mut sin, mut cos) = (angle, Self::of(1.0));
        let mut term = angle;
        for n in 2..TERMS {
            term = (term * angle).over_whole(n);
            let signed = if n % 4 < 2 { term } else { -term };
            if n % 2 == 0 {
                cos = cos + signed;
            } else {
                sin = sin + signed;
            }
            if term.is_zero() || term.exponent < angle.exponent - 300 {
                break;
            }
        }
        match turns.rem_euclid(4.0) {
            0.0 => (sin, cos),
            1.0 => (cos, -sin),
            2.0 => (-sin, -cos),
            _ => (-cos, sin),
        }
    }

    /// Angle of the vector (x, self) from +x in (−π, π]: the double's, corrected by what is left when the
    /// vector is turned back by it.
    #[must_use]
    pub fn atan2(self, x: Self) -> Self {
        if self.is_zero() {
            return if x.negative { Self::PI } else { Self::ZERO };
        }
        // Doubles of both, whatever their sizes.
        let power = -self.exponent.max(if x.is_zero() { i32::MIN + 1 } else { x.exponent });
        let rough = libm::atan2(self.shifted(power).to_f64(), x.shifted(power).to_f64());
        let (sin, cos) = Self::of(rough).sin_cos();
        let rest = (self * cos - x * sin) / (x * cos + self * sin);
        // The rest is about 10⁻¹⁶; the seventh power is below all digits.
        let square = rest * rest;
        let series = Self::of(1.0) - square.over_whole(3) + (square * square).over_whole(5);
        Self::of(rough) + rest * series
    }
}

impl PartialOrd for Wide {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        if !self.is_number() || !other.is_number() {
            return None;
        }
        let sign = |w: &Self| if w.is_zero() { 0 } else { 1 - 2 * i32::from(w.negative) };
        let by_sign = sign(self).cmp(&sign(other));
        Some(by_sign.then_with(|| {
            let sizes = self.compare_sizes(other);
            if self.negative { sizes.reverse() } else { sizes }
        }))
    }
}

impl Neg for Wide {
    type Output = Self;

    fn neg(self) -> Self {
        Self { negative: !self.negative && !self.is_zero(), ..self }
    }
}

impl Add for Wide {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        if !self.is_number() || !other.is_number() {
            return Self::INVALID;
        }
        let (large, small) = match self.compare_sizes(&other) {
            Ordering::Less => (other, self),
            _ => (self, other),
        };
        let apart = i64::from(large.exponent) - i64::from(small.exponent);
        if small.is_zero() || apart > 320 {
            return large;
        }
        // A limb below both keeps what cancellation brings up, one above takes the carry.
        let place = |w: &Self| [0, w.limbs[0], w.limbs[1], w.limbs[2], w.limbs[3], 0];
        let (mut sum, mut part) = (place(&large), place(&small));
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 320")]
        let (whole, bits) = ((apart / 64) as usize, (apart % 64) as u32);
        for i in 0..6 {
            let limb = |i: usize| part.get(i).copied().unwrap_or(0);
            let low = limb(i + whole) >> bits;
            let high = if bits > 0 { limb(i + whole + 1) << (64 - bits) } else { 0 };
            part[i] = low | high;
        }
        let mut carry = false;
        for (to, from) in sum.iter_mut().zip(part) {
            let (first, one) = if large.negative == small.negative {
                to.overflowing_add(from)
            } else {
                to.overflowing_sub(from)
            };
            let (second, two) = if large.negative == small.negative {
                first.overflowing_add(u64::from(carry))
            } else {
                first.overflowing_sub(u64::from(carry))
            };
            *to = second;
            carry = one || two;
        }
        Self::normal(large.negative, large.exponent.saturating_add(64), sum)
    }
}

impl Sub for Wide {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Mul for Wide {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        if !self.is_number() || !other.is_number() {
            return Self::INVALID;
        }
        if self.is_zero() || other.is_zero() {
            return Self::ZERO;
        }
        let mut product = [0_u64; 8];
        for (i, a) in self.limbs.iter().enumerate() {
            let mut carry = 0_u128;
            for (j, b) in other.limbs.iter().enumerate() {
                let part = u128::from(*a) * u128::from(*b) + u128::from(product[i + j]) + carry;
                #[expect(clippy::cast_possible_truncation, reason = "the low limb")]
                {
                    product[i + j] = part as u64;
                }
                carry = part >> 64;
            }
            #[expect(clippy::cast_possible_truncation, reason = "below 2^64")]
            {
                product[i + 4] = carry as u64;
            }
        }
        let exponent = self.exponent.saturating_add(other.exponent);
        Self::normal(self.negative != other.negative, exponent, product)
    }
}

impl Div for Wide {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        if !self.is_number() || !other.is_number() || other.is_zero() {
            return Self::INVALID;
        }
        let divisor = other.shifted(-other.exponent);
        let mut inverse = Self::of(1.0 / divisor.to_f64());
        // y ← y (2 − b y) doubles the digits: 53, 106, 212.
        for _ in 0..2 {
            inverse = inverse * (Self::of(2.0) - divisor * inverse);
        }
        let quotient = self * inverse;
        let rest = self - quotient * divisor;
        (quotient + rest * inverse).shifted(-other.exponent)
    }
}
