//! The operations of the tape, each with its value, its derivatives, its rounding and what its tangent leaves out.
//! Whoever evaluates a tape (a drawing with its bounds, a sweep, a sweep with bounds) reads these rules and no others.

use super::scalar::Real;

/// How a number follows from earlier ones, in the order of the operands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Op {
    /// a + b.
    Sum,
    /// a − b.
    Difference,
    /// −a.
    Opposite,
    /// a · b.
    Product,
    /// a / b.
    Quotient,
    /// √a; zero for a negative a.
    Root,
    /// √a of the square of a half chord: which of two meeting points is taken depends on its sign.
    HalfChord,
    /// a·b + c·d.
    Dot,
    /// a·b − c·d.
    Cross,
    /// cos a.
    Cosine,
    /// sin a.
    Sine,
    /// Angle of the vector (b, a) from +x.
    Angle,
    /// The same, of something that may turn more than half round.
    Turned,
    /// The largest whole number that is not greater than a.
    Whole,
}

/// At most this many operands.
pub(super) const MOST_OPERANDS: usize = 4;

/// The partial derivatives are computed in doubles, by up to three roundings each.
pub(super) const OF_PARTIALS: f64 = 2.0 * f64::EPSILON;

/// What the errors of the operands do to a result beyond its tangent.
#[derive(Debug, Clone, Copy)]
pub(super) struct Beyond {
    /// At most so much; infinite where nobody can tell.
    pub(super) left_out: f64,
    /// False where the errors are too large for a tangent: `left_out` is then all that they do.
    pub(super) has_tangent: bool,
}

impl Op {
    /// How many operands it takes.
    #[inline]
    pub(super) const fn operands(self) -> usize {
        match self {
            Self::Opposite | Self::Root | Self::HalfChord | Self::Cosine | Self::Sine | Self::Whole => 1,
            Self::Sum | Self::Difference | Self::Product | Self::Quotient | Self::Angle | Self::Turned => 2,
            Self::Dot | Self::Cross => 4,
        }
    }

    /// The result in any arithmetic.
    #[inline]
    pub(super) fn value<R: Real>(self, [a, b, c, d]: [R; MOST_OPERANDS]) -> R {
        match self {
            Self::Sum => a + b,
            Self::Difference => a - b,
            Self::Opposite => -a,
            Self::Product => a * b,
            Self::Quotient => a / b,
            Self::Root | Self::HalfChord => a.sqrt(),
            Self::Dot => a * b + c * d,
            Self::Cross => a * b - c * d,
            Self::Cosine => a.cos(),
            Self::Sine => a.sin(),
            Self::Angle | Self::Turned => a.atan2(b),
            Self::Whole => {
                let nearest = R::from_f64(libm::floor(a.to_f64()));
                // What lies just below a whole number may have been rounded up to it.
                if a < nearest { nearest - R::from_f64(1.0) } else { nearest }
            }
        }
    }

    /// The partial derivatives by the operands; zero where there are none.
    #[inline(always)]
    pub(super) fn partials(self, [a, b, c, d]: [f64; MOST_OPERANDS], value: f64) -> [f64; MOST_OPERANDS] {
        let finite = |x: f64| if x.is_finite() { x } else { 0.0 };
        match self {
            Self::Sum => [1.0, 1.0, 0.0, 0.0],
            Self::Difference => [1.0, -1.0, 0.0, 0.0],
            Self::Opposite => [-1.0, 0.0, 0.0, 0.0],
            Self::Product => [b, a, 0.0, 0.0],
            Self::Quotient if divides(a / b, b) => [1.0 / b, -value / b, 0.0, 0.0],
            Self::Quotient => [0.0; MOST_OPERANDS],
            Self::Root | Self::HalfChord => [finite(0.5 / value), 0.0, 0.0, 0.0],
            Self::Dot => [b, a, d, c],
            Self::Cross => [b, a, -d, -c],
            Self::Cosine => [-libm::sin(a), 0.0, 0.0, 0.0],
            Self::Sine => [libm::cos(a), 0.0, 0.0, 0.0],
            Self::Angle | Self::Turned => {
                let square = a * a + b * b;
                [finite(b / square), finite(-a / square), 0.0, 0.0]
            }
            Self::Whole => [0.0; MOST_OPERANDS],
        }
    }

    /// What the operation alone may put its result off, in an arithmetic; operands and result rounded to doubles.
    #[inline(always)]
    pub(super) fn rounding<R: Real>(self, [a, b, c, d]: [f64; MOST_OPERANDS], value: f64) -> f64 {
        let real = R::from_f64;
        let transcendental = R::UNIT_ROUNDOFF * R::TRANSCENDENTAL_ULPS;
        match self {
            Self::Sum => R::rounding_of_sum(real(a), real(b), real(value)),
            Self::Difference => R::rounding_of_sum(real(a), real(-b), real(value)),
            Self::Opposite | Self::Whole => 0.0,
            // Powers of two only shift.
            Self::Product if is_power_of_two(a) || is_power_of_two(b) => {
                underflow::<R>(value, a != 0.0 && b != 0.0)
            }
            Self::Quotient if is_power_of_two(b) => underflow::<R>(value, a != 0.0),
            Self::Product => R::rounding(value) + underflow::<R>(value, a != 0.0 && b != 0.0),
            Self::Quotient => R::rounding(value) + underflow::<R>(value, a != 0.0),
            Self::Root | Self::HalfChord => R::rounding(value),
            Self::Dot | Self::Cross => {
                let (ab, cd) = (a * b, c * d);
                R::rounding(ab)
                    + R::rounding(cd)
                    + underflow::<R>(ab, a != 0.0 && b != 0.0)
                    + underflow::<R>(cd, c != 0.0 && d != 0.0)
                    + R::rounding(value)
            }
            // Along the x-axis sine and cosine are exact.
            Self::Cosine | Self::Sine if a == 0.0 => 0.0,
            Self::Cosine | Self::Sine => transcendental * value.abs().max(R::SINE_FLOOR) + R::rounding(value),
            Self::Angle | Self::Turned => transcendental * value.abs() + R::rounding(value),
        }
    }

    /// What the errors of the operands, which are `at`, do to the result beyond its tangent; `along` is what they do
    /// along it.
    #[inline]
    pub(super) fn beyond(
        self,
        at: &[f64; MOST_OPERANDS],
        partials: &[f64; MOST_OPERANDS],
        errors: &[f64; MOST_OPERANDS],
        along: f64,
    ) -> Beyond {
        // Exact zeros stay so beside what errs without bound.
        let both = |a: f64, b: f64| if a == 0.0 || b == 0.0 { 0.0 } else { a * b };
        let small = |left_out: f64| Beyond { left_out, has_tangent: true };
        let all = |left_out: f64| Beyond { left_out, has_tangent: false };
        match self {
            Self::Sum | Self::Difference | Self::Opposite => small(0.0),
            Self::Product => small(both(errors[0], errors[1])),
            Self::Dot | Self::Cross => small(both(errors[0], errors[1]) + both(errors[2], errors[3])),
            // â/b̂ − a/b is its first order times b̂/b.
            Self::Quotient => {
                let part = both(partials[0].abs(), errors[1]);
                if part < 0.5 { small(along * part / (1.0 - part)) } else { small(f64::INFINITY) }
            }
            // The root r of â = r² moves by r(1 − √(1 − t)) for an error of t â: r t/2, and at most r t²/2 beyond
            // it as long as t ≤ 1; and never by more than √(t â).
            Self::Root | Self::HalfChord => {
                let (twice, moved) = (2.0 * partials[0].abs(), errors[0]);
                let part = both(moved, twice * twice);
                if twice > 0.0 && part <= 1.0 {
                    small(part * part / (2.0 * twice))
                } else {
                    all(moved.sqrt())
                }
            }
            Self::Cosine | Self::Sine => small((0.5 * errors[0] * errors[0]).min(2.0 + errors[0])),
            // The logarithm of 1 + z for |z| = ρ leaves its tangent by no more than ρ²/(2(1 − ρ)).
            Self::Angle | Self::Turned => {
                let reach = libm::hypot(partials[0], partials[1]);
                let part = reach * libm::hypot(errors[0], errors[1]);
                if reach > 0.0 && part <= 0.5 {
                    small(part * part / (2.0 * (1.0 - part)))
                } else {
                    all(std::f64::consts::PI)
                }
            }
            // A step between two whole numbers, which the operand is clear of or not.
            Self::Whole => {
                let past = at[0] - libm::floor(at[0]);
                let room = past.min(1.0 - past);
                if errors[0] < room { small(0.0) } else { all(libm::ceil(errors[0]) + 1.0) }
            }
        }
    }
}

/// Whether a quotient and its derivatives are numbers.
#[inline]
pub(super) fn divides(quotient: f64, divisor: f64) -> bool {
    quotient.is_finite() && (1.0 / divisor).is_finite() && (quotient / divisor).is_finite()
}

/// Whether a number is a power of two with a sign, of those with all digits.
#[inline]
fn is_power_of_two(x: f64) -> bool {
    const DIGITS: u64 = (1 << 52) - 1;
    x.is_normal() && x.to_bits() & DIGITS == 0
}

/// What a product or quotient may lose below the smallest number with all digits; nothing where a factor is zero.
#[inline]
fn underflow<R: Real>(value: f64, not_zero: bool) -> f64 {
    if not_zero && value.abs() < R::SMALLEST { R::UNDERFLOW } else { 0.0 }
}
