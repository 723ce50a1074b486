//! An arithmetic that shares nothing with the board's: whole numbers of 2⁻⁴⁰⁰, more than a hundred digits
//! after the point.

use std::ops::{Add, Div, Mul, Neg, Sub};

use linkgram::double_double::DoubleDouble;
use linkgram::wide::Wide;
use num_bigint::BigInt;

/// Digits after the binary point.
const BITS: u64 = 400;

/// A number to a hundred digits.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) struct Exact(BigInt);

impl Exact {
    /// A double as it stands; it must not reach below 2⁻⁴⁰⁰.
    pub(crate) fn of(value: f64) -> Self {
        assert!(value.is_finite());
        let bits = value.to_bits();
        let exponent = (bits >> 52) & 0x7ff;
        let fraction = bits & ((1 << 52) - 1);
        let (mantissa, power) = if exponent == 0 {
            (fraction, -1074)
        } else {
            (fraction | (1 << 52), exponent.cast_signed() - 1075)
        };
        let shift = power + BITS.cast_signed();
        let whole = BigInt::from(mantissa);
        let magnitude = if shift >= 0 {
            whole << shift.unsigned_abs()
        } else {
            let kept = &whole >> shift.unsigned_abs();
            assert_eq!(&kept << shift.unsigned_abs(), whole, "{value:e} is finer than this arithmetic");
            kept
        };
        Self(if value < 0.0 { -magnitude } else { magnitude })
    }

    /// A double-double as it stands.
    pub(crate) fn fine(value: DoubleDouble) -> Self {
        Self::of(value.hi()) + Self::of(value.lo())
    }

    /// A number of 75 digits as it stands.
    pub(crate) fn wide(value: Wide) -> Self {
        let (mut sum, mut rest) = (Self::zero(), value);
        while rest != Wide::ZERO {
            let part = rest.to_f64();
            sum = sum + Self::of(part);
            rest = rest - Wide::of(part);
        }
        sum
    }

    /// A number as written in decimals.
    pub(crate) fn decimal(text: &str) -> Self {
        let (mantissa, exponent) = text.split_once(['e', 'E']).unwrap_or((text, "0"));
        let (whole, part) = mantissa.split_once('.').unwrap_or((mantissa, ""));
        let digits: BigInt = format!("{whole}{part}").parse().expect("digits");
        let power =
            exponent.parse::<i64>().expect("an exponent") - i64::try_from(part.len()).expect("few digits");
        let ten = BigInt::from(10).pow(u32::try_from(power.unsigned_abs()).expect("a small exponent"));
        Self(if power < 0 { (digits << BITS) / ten } else { (digits * ten) << BITS })
    }

    /// So many digits after the point, cut off.
    pub(crate) fn to_decimal(&self, digits: u32) -> String {
        let scaled = (&self.0 * BigInt::from(10).pow(digits)) >> BITS;
        let negative = scaled.sign() == num_bigint::Sign::Minus;
        let text = format!("{:0>width$}", scaled.magnitude().to_string(), width = digits as usize + 1);
        let (whole, part) = text.split_at(text.len() - digits as usize);
        let part = part.trim_end_matches('0');
        let point = if part.is_empty() { "" } else { "." };
        format!("{}{whole}{point}{part}", if negative { "-" } else { "" })
    }

    /// π, by Machin's formula.
    pub(crate) fn pi() -> Self {
        let arc_cotangent = |x: i64| {
            let (mut power, mut sum) = (Self::ratio(1, x), Self::zero());
            for n in 0..300 {
                let term = &power / Self::ratio(2 * n + 1, 1);
                sum = if n % 2 == 0 { sum + term } else { sum - term };
                power = power / Self::ratio(x * x, 1);
            }
            sum
        };
        Self::ratio(16, 1) * arc_cotangent(5) - Self::ratio(4, 1) * arc_cotangent(239)
    }

    /// A fraction of whole numbers.
    pub(crate) fn ratio(numerator: i64, denominator: i64) -> Self {
        Self((BigInt::from(numerator) << BITS) / BigInt::from(denominator))
    }

    pub(crate) fn zero() -> Self {
        Self::ratio(0, 1)
    }

    pub(crate) fn one() -> Self {
        Self::ratio(1, 1)
    }

    pub(crate) fn abs(&self) -> Self {
        if self.0.sign() == num_bigint::Sign::Minus { Self(-&self.0) } else { self.clone() }
    }

    /// The root of a number that is not negative.
    pub(crate) fn sqrt(&self) -> Self {
        assert!(*self >= Self::zero(), "root of a negative number");
        Self((&self.0 << BITS).sqrt())
    }

    /// √(x² + y²).
    pub(crate) fn hypot(x: &Self, y: &Self) -> Self {
        (x * x + y * y).sqrt()
    }

    /// Cosine and sine of an angle in radians of moderate size, by their series for the 2¹⁶th part and
    /// doubling.
    pub(crate) fn cos_sin(&self) -> [Self; 2] {
        const HALVINGS: u32 = 16;
        let part = Self(&self.0 >> HALVINGS);
        let (mut cos, mut sin) = (Self::one(), Self::zero());
        let mut term = Self::one();
        for n in 1..60 {
            term = &term * &part / Self::ratio(n, 1);
            match n % 4 {
                1 => sin = sin + &term,
                2 => cos = cos - &term,
                3 => sin = sin - &term,
                _ => cos = cos + &term,
            }
        }
        for _ in 0..HALVINGS {
            let doubled = &cos * &cos - &sin * &sin;
            sin = Self::ratio(2, 1) * &sin * &cos;
            cos = doubled;
        }
        [cos, sin]
    }

    /// A double near the number: good for comparing differences with bounds, to 10⁻¹⁵ of itself.
    pub(crate) fn near(&self) -> f64 {
        let bits = self.0.bits();
        if bits == 0 {
            return 0.0;
        }
        let shift = bits.saturating_sub(60);
        let top = i64::try_from(&self.0 >> shift).expect("sixty bits");
        #[expect(clippy::cast_precision_loss, reason = "a double near the number is what is wanted")]
        let mut value = top as f64;
        let power = shift.cast_signed() - BITS.cast_signed();
        for _ in 0..power.unsigned_abs() {
            value = if power < 0 { value / 2.0 } else { value * 2.0 };
        }
        value
    }

    /// |double − number|.
    pub(crate) fn error_of(&self, value: f64) -> f64 {
        (Self::of(value) - self).abs().near()
    }

    /// |double-double − number|.
    pub(crate) fn error_of_fine(&self, value: DoubleDouble) -> f64 {
        (Self::fine(value) - self).abs().near()
    }
}

macro_rules! operator {
    ($trait:ident, $method:ident, |$a:ident, $b:ident| $result:expr) => {
        impl $trait<&Exact> for &Exact {
            type Output = Exact;

            fn $method(self, other: &Exact) -> Exact {
                let ($a, $b) = (&self.0, &other.0);
                Exact($result)
            }
        }

        impl $trait<Exact> for Exact {
            type Output = Exact;

            fn $method(self, other: Exact) -> Exact {
                (&self).$method(&other)
            }
        }

        impl $trait<&Exact> for Exact {
            type Output = Exact;

            fn $method(self, other: &Exact) -> Exact {
                (&self).$method(other)
            }
        }

        impl $trait<Exact> for &Exact {
            type Output = Exact;

            fn $method(self, other: Exact) -> Exact {
                self.$method(&other)
            }
        }
    };
}

operator!(Add, add, |a, b| a + b);
operator!(Sub, sub, |a, b| a - b);
operator!(Mul, mul, |a, b| (a * b) >> BITS);
operator!(Div, div, |a, b| (a << BITS) / b);

impl Neg for Exact {
    type Output = Self;

    fn neg(self) -> Self {
        Self(-self.0)
    }
}
