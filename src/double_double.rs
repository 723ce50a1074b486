//! Double-double arithmetic: a number as the unevaluated sum of two doubles, about 31 decimal digits.
//!
//! The four operations follow M. Joldes, J.-M. Muller, V. Popescu, *Tight and rigorous error bounds for
//! basic building blocks of double-word arithmetic*, ACM Trans. Math. Softw. 44 (2017); the numbers of
//! algorithms and bounds below are theirs, with u = 2⁻⁵³. Products are split as T. J. Dekker did it (1971):
//! no fused multiply-add, whose speed depends on the machine.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// hi + lo with |lo| ≤ ½ ulp(hi).
#[derive(Debug, Clone, Copy, PartialEq, PartialOrd, Default)]
pub struct DoubleDouble {
    hi: f64,
    lo: f64,
}

/// a + b as a rounded sum and its error, exactly (Knuth's 2Sum).
fn two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    let a_part = s - b;
    let b_part = s - a_part;
    (s, (a - a_part) + (b - b_part))
}

/// The same for |a| ≥ |b| (Dekker's Fast2Sum).
fn fast_two_sum(a: f64, b: f64) -> (f64, f64) {
    let s = a + b;
    (s, b - (s - a))
}

/// A double as two halves of 26 bits.
fn halves(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0;
    let c = SPLITTER * a;
    let high = c - (c - a);
    (high, a - high)
}

/// a · b as a rounded product and its error, exactly where neither over- nor underflows.
fn two_product(a: f64, b: f64) -> (f64, f64) {
    let p = a * b;
    let ((a1, a2), (b1, b2)) = (halves(a), halves(b));
    (p, a2 * b2 - (((p - a1 * b1) - a2 * b1) - a1 * b2))
}

/// π/16 in three parts, for the reduction of angles.
const SIXTEENTH: [f64; 3] =
    [0.196_349_540_849_362_07, 7.654_042_494_670_958e-18, -1.871_731_131_073_962_3e-34];

/// Sine and cosine of 0, π/16 … 4π/16.
const ARCS: [[DoubleDouble; 2]; 5] = [
    [DoubleDouble::of(0.0), DoubleDouble::of(1.0)],
    [
        DoubleDouble { hi: 0.195_090_322_016_128_28, lo: -7.991_079_068_461_731e-18 },
        DoubleDouble { hi: 0.980_785_280_403_230_4, lo: 1.854_693_999_782_500_6e-17 },
    ],
    [
        DoubleDouble { hi: 0.382_683_432_365_089_8, lo: -1.005_077_269_646_158_8e-17 },
        DoubleDouble { hi: 0.923_879_532_511_286_7, lo: 1.764_504_708_433_667_7e-17 },
    ],
    [
        DoubleDouble { hi: 0.555_570_233_019_602_2, lo: 4.709_410_940_561_677e-17 },
        DoubleDouble { hi: 0.831_469_612_302_545_2, lo: 1.407_385_698_472_802_4e-18 },
    ],
    [
        DoubleDouble { hi: std::f64::consts::FRAC_1_SQRT_2, lo: -4.833_646_656_726_457e-17 },
        DoubleDouble { hi: std::f64::consts::FRAC_1_SQRT_2, lo: -4.833_646_656_726_457e-17 },
    ],
];

/// 1/n! for n = 2 … 9: those that the first terms need to all digits.
const INVERSE_FACTORIALS: [DoubleDouble; 8] = [
    DoubleDouble::of(0.5),
    DoubleDouble { hi: 0.166_666_666_666_666_66, lo: 9.251_858_538_542_97e-18 },
    DoubleDouble { hi: 0.041_666_666_666_666_664, lo: 2.312_964_634_635_742_7e-18 },
    DoubleDouble { hi: 0.008_333_333_333_333_333, lo: 1.156_482_317_317_871_4e-19 },
    DoubleDouble { hi: 0.001_388_888_888_888_889, lo: -5.300_543_954_373_577e-20 },
    DoubleDouble { hi: 0.000_198_412_698_412_698_4, lo: 1.720_955_829_342_070_5e-22 },
    DoubleDouble { hi: 2.480_158_730_158_73e-5, lo: 2.151_194_786_677_588_2e-23 },
    DoubleDouble { hi: 2.755_731_922_398_589_3e-6, lo: -1.858_393_274_046_472e-22 },
];

impl DoubleDouble {
    /// Every operation but the transcendental ones errs by at most this times its result: 16 u², above the
    /// 15 u² of the division (DWDivDW2), 7 u² of the product (DWTimesDW1), 3 u² of the sum
    /// (AccurateDWPlusDW), 25/8 u² of the root.
    pub const ROUNDOFF: f64 = 16.0 * (f64::EPSILON / 2.0) * (f64::EPSILON / 2.0);

    /// π.
    pub const PI: Self = Self { hi: std::f64::consts::PI, lo: 1.224_646_799_147_353_2e-16 };

    /// A double, exactly.
    #[must_use]
    pub const fn of(value: f64) -> Self {
        Self { hi: value, lo: 0.0 }
    }

    /// The sum of two doubles, exactly.
    #[must_use]
    pub fn sum(a: f64, b: f64) -> Self {
        let (hi, lo) = two_sum(a, b);
        Self { hi, lo }
    }

    /// The nearest double.
    #[must_use]
    pub const fn hi(self) -> f64 {
        self.hi
    }

    /// What the nearest double leaves.
    #[must_use]
    pub const fn lo(self) -> f64 {
        self.lo
    }

    /// A number as written in decimals (`-1.25e-3`), to within 8 [`DoubleDouble::ROUNDOFF`] of itself;
    /// `None` for other text and for numbers near the ends of the range of doubles.
    #[must_use]
    pub fn parse(text: &str) -> Option<Self> {
        /// Digits beyond these are below the last bit.
        const MOST_DIGITS: i32 = 34;
        /// A chunk of digits that a double holds exactly.
        const CHUNK: i32 = 15;
        /// 10²² is the largest power of ten that a double holds exactly.
        const STEP: i32 = 22;
        let (mantissa, exponent) = match text.split_once(['e', 'E']) {
            Some((mantissa, exponent)) => (mantissa, exponent.parse::<i32>().ok()?),
            None => (text, 0),
        };
        let (negative, mantissa) = match mantissa.as_bytes().first()? {
            b'-' => (true, &mantissa[1..]),
            b'+' => (false, &mantissa[1..]),
            _ => (false, mantissa),
        };
        let power_of_ten = |n: i32| (0..n).fold(1.0_f64, |p, _| p * 10.0);
        let mut value = Self::of(0.0);
        let (mut chunk, mut in_chunk, mut used) = (0.0_f64, 0, 0);
        let (mut scale, mut after_point) = (exponent, false);
        for byte in mantissa.bytes() {
            match byte {
                b'.' if !after_point => after_point = true,
                b'0'..=b'9' if used < MOST_DIGITS => {
                    chunk = chunk * 10.0 + f64::from(byte - b'0');
                    in_chunk += 1;
                    used += i32::from(used > 0 || byte != b'0');
                    scale = scale.checked_sub(i32::from(after_point))?;
                    if in_chunk == CHUNK {
                        value = value * Self::of(power_of_ten(CHUNK)) + Self::of(chunk);
                        (chunk, in_chunk) = (0.0, 0);
                    }
                }
                b'0'..=b'9' => scale = scale.checked_add(i32::from(!after_point))?,
                _ => return None,
            }
        }
        if in_chunk > 0 {
            value = value * Self::of(power_of_ten(in_chunk)) + Self::of(chunk);
        }
        if value.hi != 0.0 && !(-250..250).contains(&(scale + used)) {
            return None;
        }
        while scale != 0 && value.hi != 0.0 {
            let step = scale.clamp(-STEP, STEP);
            let power = Self::of(power_of_ten(step.abs()));
            value = if step < 0 { value / power } else { value * power };
            scale -= step;
        }
        Some(if negative { -value } else { value })
    }

    /// |self|.
    #[must_use]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// The root; of a negative number, zero. Error below 25/8 u² (SQRTDWtoDW; V. Lefèvre, N. Louvet,
    /// J.-M. Muller, J. Picot, L. Rideau, *Accurate calculation of Euclidean norms using double-word
    /// arithmetic*, 2022).
    #[must_use]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::of(0.0);
        }
        let root = self.hi.sqrt();
        let (square, error) = two_product(root, root);
        let rest = ((self.hi - square) - error) + self.lo;
        let (hi, lo) = fast_two_sum(root, rest / (2.0 * root));
        Self { hi, lo }
    }

    /// Sine and cosine of an angle in radians up to a million; each errs by at most four
    /// [`DoubleDouble::ROUNDOFF`] absolutely, and relatively for angles below π/32.
    #[must_use]
    pub fn sin_cos(self) -> (Self, Self) {
        // self = m π/16 + t, |t| ≤ π/32.
        let m = (self.hi / SIXTEENTH[0]).round();
        let t = if m == 0.0 {
            self
        } else {
            let (p0, e0) = two_product(m, SIXTEENTH[0]);
            let (p1, e1) = two_product(m, SIXTEENTH[1]);
            // The difference of the leading parts is exact: they lie within a factor of two.
            Self::sum(self.hi - p0, self.lo) - Self::sum(e0, p1) - Self::of(e1 + m * SIXTEENTH[2])
        };
        let (s, c) = t.sin_cos_of_small();
        let quarter = (m / 8.0).round();
        let arc = m - 8.0 * quarter;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole, 0 to 4")]
        let [sin, cos] = ARCS[arc.abs() as usize];
        let sin = if arc < 0.0 { -sin } else { sin };
        let (s, c) = if arc == 0.0 { (s, c) } else { (sin * c + cos * s, cos * c - sin * s) };
        let turns = quarter - 4.0 * (quarter / 4.0).floor();
        if turns == 0.0 {
            (s, c)
        } else if turns == 1.0 {
            (c, -s)
        } else if turns == 2.0 {
            (-s, -c)
        } else {
            (-c, s)
        }
    }

    /// Taylor's series for |self| ≤ π/32; the terms below 2⁻⁵³ of the first are summed in doubles.
    fn sin_cos_of_small(self) -> (Self, Self) {
        let z = self * self;
        let z0 = z.hi;
        let sine_tail = -2.505_210_838_544_172e-8
            + z0 * (1.605_904_383_682_161_3e-10
                + z0 * (-7.647_163_731_819_816e-13 + z0 * 2.811_457_254_345_520_6e-15));
        let cosine_tail = -2.755_731_922_398_589e-7
            + z0 * (2.087_675_698_786_81e-9
                + z0 * (-1.147_074_559_772_972_5e-11
                    + z0 * (4.779_477_332_387_385e-14 - z0 * 1.561_920_696_858_622_6e-16)));
        let [c2, s3, c4, s5, c6, s7, c8, s9] = INVERSE_FACTORIALS;
        let sine = ((s9 + z * Self::of(sine_tail)) * z - s7) * z + s5;
        let sine = self + self * z * (sine * z - s3);
        let cosine = ((c8 + z * Self::of(cosine_tail)) * z - c6) * z + c4;
        let cosine = Self::of(1.0) + z * (cosine * z - c2);
        (sine, cosine)
    }

    /// Angle of the vector (x, self) from +x in (−π, π], to eight [`DoubleDouble::ROUNDOFF`] of itself: the
    /// double's angle, corrected by what is left when the vector is turned back by it.
    #[must_use]
    pub fn atan2(self, x: Self) -> Self {
        let rough = libm::atan2(self.hi, x.hi);
        if (self.hi == 0.0 && x.hi >= 0.0) || !rough.is_finite() {
            return Self::of(rough);
        }
        let (sin, cos) = Self::of(rough).sin_cos();
        // The rest is about 10⁻¹⁶: its own tangent.
        let rest = (self * cos - x * sin) / (x * cos + self * sin);
        let angle = Self::of(rough) + rest;
        if rest.hi.is_finite() { angle } else { Self::of(rough) }
    }

    /// `digits` significant digits, as in `-123.4567` or `1.2e-9`; at most 31 mean something.
    #[must_use]
    pub fn decimals(self, digits: usize) -> String {
        if self.hi == 0.0 || !self.hi.is_finite() {
            return format!("{}", self.hi);
        }
        let digits = digits.clamp(1, 32);
        #[expect(clippy::cast_possible_truncation, reason = "an exponent of a double")]
        let mut exponent = libm::floor(libm::log10(self.hi.abs())) as i32;
        let ten = Self::of(10.0);
        let mut rest = self.abs();
        let mut shift = exponent;
        while shift != 0 {
            (rest, shift) = if shift > 0 { (rest / ten, shift - 1) } else { (rest * ten, shift + 1) };
        }
        // The rounded logarithm may miss the power of ten by one.
        if rest >= ten {
            (rest, exponent) = (rest / ten, exponent + 1);
        } else if rest < Self::of(1.0) {
            (rest, exponent) = (rest * ten, exponent - 1);
        }
        let mut figures: Vec<u8> = Vec::with_capacity(digits + 1);
        for _ in 0..=digits {
            let mut figure = rest.hi.floor();
            if rest - Self::of(figure) < Self::of(0.0) {
                figure -= 1.0;
            }
            let figure = figure.clamp(0.0, 9.0);
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "0 to 9")]
            figures.push(figure as u8);
            rest = (rest - Self::of(figure)) * ten;
        }
        let up = figures.pop().is_some_and(|last| last >= 5);
        if up {
            let mut place = digits;
            while place > 0 && figures[place - 1] == 9 {
                figures[place - 1] = 0;
                place -= 1;
            }
            if place > 0 {
                figures[place - 1] += 1;
            } else {
                figures.insert(0, 1);
                figures.pop();
                exponent += 1;
            }
        }
        let sign = if self.hi < 0.0 { "-" } else { "" };
        let figures: String = figures.iter().map(|f| char::from(b'0' + f)).collect();
        let last = i32::try_from(digits).unwrap_or(i32::MAX) - 1;
        let point = |at: usize| if at < figures.len() { "." } else { "" };
        match usize::try_from(exponent) {
            Ok(whole) if exponent <= last => {
                let (whole, part) = figures.split_at(whole + 1);
                format!("{sign}{whole}{}{part}", point(whole.len()))
            }
            Err(_) if exponent > -5 => {
                let zeros = "0".repeat(usize::try_from(-1 - exponent).unwrap_or(0));
                format!("{sign}0.{zeros}{figures}")
            }
            _ => format!("{sign}{}{}{}e{exponent}", &figures[..1], point(1), &figures[1..]),
        }
    }
}

impl Add for DoubleDouble {
    type Output = Self;

    /// AccurateDWPlusDW: error below 3 u² + 13 u³.
    fn add(self, other: Self) -> Self {
        let (s, e) = two_sum(self.hi, other.hi);
        let (t, f) = two_sum(self.lo, other.lo);
        let (s, e) = fast_two_sum(s, e + t);
        let (hi, lo) = fast_two_sum(s, f + e);
        Self { hi, lo }
    }
}

impl Sub for DoubleDouble {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for DoubleDouble {
    type Output = Self;

    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Mul for DoubleDouble {
    type Output = Self;

    /// DWTimesDW1: error below 7 u².
    fn mul(self, other: Self) -> Self {
        let (p, e) = two_product(self.hi, other.hi);
        let cross = self.hi * other.lo + self.lo * other.hi;
        let (hi, lo) = fast_two_sum(p, e + cross);
        Self { hi, lo }
    }
}

impl Div for DoubleDouble {
    type Output = Self;

    /// DWDivDW2: error below 15 u² + 56 u³.
    fn div(self, other: Self) -> Self {
        let first = self.hi / other.hi;
        // other · first, rounded to a double-double (DWTimesFP3).
        let (p, e) = two_product(other.hi, first);
        let (ph, pl) = fast_two_sum(p, e + other.lo * first);
        let rest = (self.hi - ph) + (self.lo - pl);
        let (hi, lo) = fast_two_sum(first, rest / other.hi);
        Self { hi, lo }
    }
}
