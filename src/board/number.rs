//! Scalar operations of the board: each is computed and written on the tape.

use super::hand::Pencil;
use super::op::{MOST_OPERANDS, Op, divides};
use super::tape::{Reason, Role};
use super::{Board, Num};
use crate::given::Given;

/// The reason of a number too large for the arithmetic.
pub const TOO_LARGE: Reason = Reason::MAX;

impl Board {
    /// A number of the scene, with its uncertainty.
    pub fn given(&mut self, given: Given) -> Num {
        self.leaf(given, Role::Given)
    }

    /// The place of an input, which a sweep varies.
    pub(super) fn input(&mut self, index: usize, given: Given) -> Num {
        self.leaf(given, Role::Input(index))
    }

    /// The rate of an input, which changes in a sweep over time.
    pub(super) fn input_rate(&mut self, index: usize, given: Given) -> Num {
        self.leaf(given, Role::Rate(index))
    }

    /// A number that was found by trial.
    pub(super) fn tried(&mut self, given: Given) -> Num {
        self.leaf(given, Role::Tried)
    }

    fn leaf(&mut self, given: Given, role: Role) -> Num {
        let (value, mark, finite) = self.tape.leaf(given, role);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    /// An exact number.
    pub fn exact(&mut self, value: f64) -> Num {
        self.given(Given::exact(value))
    }

    /// A number that the hand has pencilled: what should stand there, and how far the pencil missed it.
    pub(super) fn pencilled(&mut self, num: Num, kind: Pencil) -> Num {
        match self.slip_of_pencil(kind) {
            Some(slip) => self.add(num, slip),
            None => num,
        }
    }

    /// How far the pencil misses this time; `None` where the hand is perfect.
    pub(super) fn slip_of_pencil(&mut self, kind: Pencil) -> Option<Num> {
        let (value, mark) = self.tape.slip(kind)?;
        Some(Num { value, mark })
    }

    #[inline]
    fn in_range(&mut self, mark: u32, finite: bool) {
        if !finite {
            self.tape.divisor(mark, 0.0, TOO_LARGE);
        }
    }

    #[inline(always)]
    fn make<const N: usize>(&mut self, op: Op, of: [Num; N]) -> Num {
        let (mut marks, mut values) = ([0; MOST_OPERANDS], [0.0; MOST_OPERANDS]);
        for (index, num) in of.iter().enumerate() {
            (marks[index], values[index]) = (num.mark, num.value);
        }
        let (value, mark, finite) = self.tape.operate(op, marks, values);
        self.in_range(mark, finite);
        Num { value, mark }
    }

    pub(super) fn add(&mut self, a: Num, b: Num) -> Num {
        self.make(Op::Sum, [a, b])
    }

    pub(super) fn sub(&mut self, a: Num, b: Num) -> Num {
        self.make(Op::Difference, [a, b])
    }

    /// −a, exact.
    pub(super) fn neg(&mut self, a: Num) -> Num {
        self.make(Op::Opposite, [a])
    }

    pub(super) fn mul(&mut self, a: Num, b: Num) -> Num {
        self.make(Op::Product, [a, b])
    }

    /// a · factor for an exact factor.
    pub(super) fn times(&mut self, a: Num, factor: f64) -> Num {
        let factor = self.factor(factor);
        self.make(Op::Product, [a, factor])
    }

    /// a / divisor for an exact divisor that is not zero.
    pub(super) fn over(&mut self, a: Num, divisor: f64) -> Num {
        let divisor = self.factor(divisor);
        self.make(Op::Quotient, [a, divisor])
    }

    fn factor(&mut self, factor: f64) -> Num {
        let (value, mark) = self.tape.factor(factor);
        Num { value, mark }
    }

    /// a / b. A divisor that does not exceed its error is on the tape with its reason; the
    /// value is then meaningless but finite.
    pub(super) fn div(&mut self, a: Num, b: Num, reason: Reason) -> Num {
        self.tape.divisor(b.mark, b.value, reason);
        if divides(a.value / b.value, b.value) {
            return self.make(Op::Quotient, [a, b]);
        }
        let mark = self.tape.no_quotient([a.mark, b.mark, 0, 0]);
        Num { value: 0.0, mark }
    }

    /// √a of a number that is not negative.
    pub(super) fn sqrt(&mut self, a: Num) -> Num {
        self.make(Op::Root, [a])
    }

    /// √a of the square of a half chord.
    pub(super) fn half_root(&mut self, a: Num) -> Num {
        self.make(Op::HalfChord, [a])
    }

    /// a·b + c·d.
    pub(super) fn dot(&mut self, a: Num, b: Num, c: Num, d: Num) -> Num {
        self.make(Op::Dot, [a, b, c, d])
    }

    /// a·b − c·d.
    pub(super) fn cross(&mut self, a: Num, b: Num, c: Num, d: Num) -> Num {
        self.make(Op::Cross, [a, b, c, d])
    }

    /// Cosine and sine of an angle in radians.
    pub(super) fn cos_sin(&mut self, angle: Num) -> [Num; 2] {
        [Op::Cosine, Op::Sine].map(|op| self.make(op, [angle]))
    }

    /// Angle of the vector (x, y) from +x.
    pub(super) fn atan2(&mut self, y: Num, x: Num) -> Num {
        self.make(Op::Angle, [y, x])
    }

    /// The largest whole number that is not greater than a.
    pub(super) fn floor(&mut self, a: Num) -> Num {
        self.make(Op::Whole, [a])
    }

    /// The same for an angle that goes on beyond half a turn where the drawing is run on.
    pub(super) fn turned_angle(&mut self, y: Num, x: Num) -> Num {
        self.make(Op::Turned, [y, x])
    }
}

/// The power of two that brings a size to between a half and one; one where there is no size.
pub(super) fn power_of_two(size: f64) -> f64 {
    if !(size.is_normal()) {
        return 1.0;
    }
    let (_, exponent) = libm::frexp(size);
    // Halved, so that neither the factor nor its reciprocal leaves the doubles.
    libm::ldexp(1.0, (-exponent).clamp(-500, 500))
}
