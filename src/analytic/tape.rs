//! A recording of the arithmetic behind one number.
//!
//! Every constraint and every asked quantity is written once, as a formula over [`Jet`]s: a value with
//! its first and second time derivative. The arithmetic is recorded, and one sweep back over the record
//! gives at once the partial derivatives towards every pose, rate and parameter, and the bound of the
//! rounding errors made on the way (Linnainmaa 1976: running error analysis by the adjoint method).

use std::cell::{Cell, RefCell};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// Unit roundoff of double precision.
pub(super) const U: f64 = f64::EPSILON / 2.0;

/// Error of a function of `libm`, in units of the roundoff of its result (its own tests allow 1 ulp).
const LIBM: f64 = 2.0;

/// What most equations depend on: coordinates of two bodies, and a few parameters.
const USUAL_TERMS: usize = 10;

/// No node: an exact constant.
const EXACT: u32 = u32::MAX;

/// What a recorded number depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Leaf {
    /// A coordinate of a body: index 3·body + {0: x, 1: y, 2: θ}.
    Pose(usize),
    /// Its first time derivative.
    Rate(usize),
    /// Its second time derivative.
    Accel(usize),
    /// A parameter of the model.
    Param(usize),
    /// A multiplier of a pair equation, or an effort that is sought.
    Force(usize),
}

#[derive(Debug, Clone, Copy)]
struct Node {
    parents: [u32; 2],
    partials: [f64; 2],
    rounding: f64,
    leaf: Option<Leaf>,
}

thread_local! {
    /// Paper of records that are done with, to be written on again: a solution makes hundreds of records, one
    /// after the other.
    static PAPER: Cell<(Vec<Node>, Vec<f64>)> = const { Cell::new((Vec::new(), Vec::new())) };
}

/// The record of one evaluation.
#[derive(Debug)]
pub(super) struct Tape {
    nodes: RefCell<Vec<Node>>,
    /// What the sweeps write on.
    adjoint: RefCell<Vec<f64>>,
    order: u8,
    broken: Cell<bool>,
}

impl Drop for Tape {
    fn drop(&mut self) {
        PAPER.set((std::mem::take(self.nodes.get_mut()), std::mem::take(self.adjoint.get_mut())));
    }
}

/// A number, its rounding error and its partial derivatives, to first order.
#[derive(Debug, Clone, Default)]
pub(super) struct Linear {
    /// The computed number.
    pub(super) value: f64,
    /// Bound of the rounding errors made in computing it, first order.
    pub(super) rounding: f64,
    /// Partial derivatives, each leaf once, ascending.
    pub(super) terms: Vec<(Leaf, f64)>,
    /// Leaves on which it hangs through a product of zeros, as on ω in ω² where ω = 0: without a slope.
    pub(super) flat: Vec<Leaf>,
}

impl Tape {
    /// A record of values (0), of values and rates (1) or of accelerations too (2).
    pub(super) fn new(order: u8) -> Self {
        let (mut nodes, adjoint) = PAPER.take();
        nodes.clear();
        Self { nodes: RefCell::new(nodes), adjoint: RefCell::new(adjoint), order, broken: Cell::new(false) }
    }

    /// Whether something was divided by zero.
    pub(super) fn broken(&self) -> bool {
        self.broken.get()
    }

    fn push(&self, value: f64, node: Node) -> Var<'_> {
        let mut nodes = self.nodes.borrow_mut();
        let at = u32::try_from(nodes.len()).unwrap_or(EXACT);
        nodes.push(node);
        Var { tape: self, at, value }
    }

    fn unary(&self, value: f64, x: Var<'_>, partial: f64, rounding: f64) -> Var<'_> {
        self.push(value, Node { parents: [x.at, EXACT], partials: [partial, 0.0], rounding, leaf: None })
    }

    /// An exact constant.
    pub(super) fn constant(&self, value: f64) -> Var<'_> {
        Var { tape: self, at: EXACT, value }
    }

    /// A constant that is itself rounded.
    pub(super) fn rounded(&self, value: f64, rounding: f64) -> Var<'_> {
        self.push(value, Node { parents: [EXACT; 2], partials: [0.0; 2], rounding, leaf: None })
    }

    /// Something that the number depends on.
    pub(super) fn leaf(&self, leaf: Leaf, value: f64) -> Var<'_> {
        self.push(value, Node { parents: [EXACT; 2], partials: [0.0; 2], rounding: 0.0, leaf: Some(leaf) })
    }

    /// A number that does not change in time.
    pub(super) fn steady<'t>(&'t self, value: Var<'t>) -> Jet<'t> {
        Jet { v: value, d: self.constant(0.0), a: self.constant(0.0) }
    }

    /// An exact constant that does not change in time.
    pub(super) fn number(&self, value: f64) -> Jet<'_> {
        self.steady(self.constant(value))
    }

    /// The sweep back from `out`.
    pub(super) fn sweep(&self, out: Var<'_>) -> Linear {
        let nodes = self.nodes.borrow();
        let mut linear = Linear { value: out.value, ..Linear::default() };
        if out.at == EXACT {
            return linear;
        }
        let last = out.at as usize;
        linear.terms.reserve(USUAL_TERMS);
        let mut adjoint = self.adjoint.borrow_mut();
        adjoint.clear();
        adjoint.resize(last + 1, 0.0);
        // Behind a product of two zeros there is no slope, but the product depends on both.
        let mut behind_zeros: Vec<bool> = Vec::new();
        adjoint[last] = 1.0;
        for at in (0..=last).rev() {
            let weight = adjoint[at];
            let node = &nodes[at];
            let levelled = weight != 0.0 && node.parents != [EXACT; 2] && node.partials == [0.0; 2];
            if levelled || behind_zeros.get(at) == Some(&true) {
                behind_zeros.resize(last + 1, false);
                linear.flat.extend(node.leaf);
                for parent in node.parents.into_iter().filter(|parent| *parent != EXACT) {
                    behind_zeros[parent as usize] = true;
                }
            }
            if weight == 0.0 {
                continue;
            }
            linear.rounding += weight.abs() * node.rounding;
            if let Some(leaf) = node.leaf {
                linear.terms.push((leaf, weight));
            }
            for (parent, partial) in node.parents.iter().zip(node.partials) {
                if *parent != EXACT {
                    adjoint[*parent as usize] += weight * partial;
                }
            }
        }
        linear.terms.sort_by_key(|term| term.0);
        linear.terms.dedup_by(|later, kept| {
            let same = later.0 == kept.0;
            if same {
                kept.1 += later.1;
            }
            same
        });
        linear
    }
}

/// A recorded number.
#[derive(Debug, Clone, Copy)]
pub(super) struct Var<'t> {
    tape: &'t Tape,
    at: u32,
    /// The number.
    pub(super) value: f64,
}

impl<'t> Var<'t> {
    fn is(self, value: f64) -> bool {
        self.at == EXACT && self.value == value
    }

    /// Square root; zero, without a derivative, where it does not exist.
    pub(super) fn sqrt(self) -> Self {
        if self.value <= 0.0 {
            self.tape.broken.set(true);
            return self.tape.constant(0.0);
        }
        let root = self.value.sqrt();
        self.tape.unary(root, self, 0.5 / root, U * root)
    }

    /// Cosine and sine.
    pub(super) fn cos_sin(self) -> [Self; 2] {
        if self.is(0.0) {
            return [self.tape.constant(1.0), self];
        }
        let (sin, cos) = libm::sincos(self.value);
        let error = |x: f64| LIBM * U * x.abs();
        [self.tape.unary(cos, self, -sin, error(cos)), self.tape.unary(sin, self, cos, error(sin))]
    }

    /// Direction of the vector (x, `self`).
    pub(super) fn atan2(self, x: Self) -> Self {
        if self.is(0.0) && x.at == EXACT && x.value > 0.0 {
            return self;
        }
        let square = self.value * self.value + x.value * x.value;
        if square <= 0.0 {
            self.tape.broken.set(true);
            return self.tape.constant(0.0);
        }
        let angle = libm::atan2(self.value, x.value);
        self.tape.push(
            angle,
            Node {
                parents: [self.at, x.at],
                partials: [x.value / square, -self.value / square],
                rounding: LIBM * U * angle.abs(),
                leaf: None,
            },
        )
    }

    /// Magnitude.
    pub(super) fn abs(self) -> Self {
        // Of a zero with its sign, too: a quotient or an angle takes that for a side.
        if self.value.is_sign_negative() { -self } else { self }
    }

    /// The same angle in (−π, π].
    pub(super) fn wrapped(self) -> Self {
        self.wrapped_about(0.0)
    }

    /// The same angle within half a turn of another one, radians, half a turn itself to the left.
    pub(super) fn wrapped_about(self, near: f64) -> Self {
        let turns = ((self.value - near) / std::f64::consts::TAU - 0.5).ceil();
        let shift = turns * std::f64::consts::TAU;
        if shift == 0.0 { self } else { self - self.tape.rounded(shift, 2.0 * U * shift.abs()) }
    }
}

impl Add for Var<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        if self.is(0.0) {
            return other;
        }
        if other.is(0.0) {
            return self;
        }
        let value = self.value + other.value;
        self.tape.push(
            value,
            Node {
                parents: [self.at, other.at],
                partials: [1.0, 1.0],
                rounding: U * value.abs(),
                leaf: None,
            },
        )
    }
}

impl Neg for Var<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        if self.at == EXACT {
            return self.tape.constant(-self.value);
        }
        self.tape.unary(-self.value, self, -1.0, 0.0)
    }
}

impl Sub for Var<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        if other.is(0.0) {
            return self;
        }
        if self.is(0.0) {
            return -other;
        }
        let value = self.value - other.value;
        self.tape.push(
            value,
            Node {
                parents: [self.at, other.at],
                partials: [1.0, -1.0],
                rounding: U * value.abs(),
                leaf: None,
            },
        )
    }
}

impl Mul for Var<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        if self.is(0.0) || other.is(1.0) {
            return self;
        }
        if other.is(0.0) || self.is(1.0) {
            return other;
        }
        let value = self.value * other.value;
        let partials = [other.value, self.value];
        // A product with ±2 or ½ is exact.
        let exact = [self, other].iter().any(|x| x.is(2.0) || x.is(-1.0) || x.is(0.5));
        let rounding = if exact { 0.0 } else { U * value.abs() };
        self.tape.push(value, Node { parents: [self.at, other.at], partials, rounding, leaf: None })
    }
}

impl Div for Var<'_> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        if other.value == 0.0 {
            self.tape.broken.set(true);
            return self.tape.constant(0.0);
        }
        if self.is(0.0) || other.is(1.0) {
            return self;
        }
        let value = self.value / other.value;
        self.tape.push(
            value,
            Node {
                parents: [self.at, other.at],
                partials: [1.0 / other.value, -value / other.value],
                rounding: U * value.abs(),
                leaf: None,
            },
        )
    }
}

/// A number with its first (`d`) and second (`a`) time derivative; those beyond the order of the tape
/// are zero and cost nothing.
#[derive(Debug, Clone, Copy)]
pub(super) struct Jet<'t> {
    /// Value.
    pub(super) v: Var<'t>,
    /// First time derivative.
    pub(super) d: Var<'t>,
    /// Second time derivative.
    pub(super) a: Var<'t>,
}

impl<'t> Jet<'t> {
    fn build(v: Var<'t>, d: impl FnOnce() -> Var<'t>, a: impl FnOnce(Var<'t>) -> Var<'t>) -> Self {
        let zero = v.tape.constant(0.0);
        let d = if v.tape.order >= 1 { d() } else { zero };
        let a = if v.tape.order >= 2 { a(d) } else { zero };
        Self { v, d, a }
    }

    fn two(self) -> Var<'t> {
        self.v.tape.constant(2.0)
    }

    /// The derivative of this order: 0, 1 or 2.
    pub(super) fn at(self, order: u8) -> Var<'t> {
        match order {
            0 => self.v,
            1 => self.d,
            _ => self.a,
        }
    }
}

impl Add for Jet<'_> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self::build(self.v + other.v, || self.d + other.d, |_| self.a + other.a)
    }
}

impl Sub for Jet<'_> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self::build(self.v - other.v, || self.d - other.d, |_| self.a - other.a)
    }
}

impl Neg for Jet<'_> {
    type Output = Self;
    fn neg(self) -> Self {
        Self::build(-self.v, || -self.d, |_| -self.a)
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "Leibniz's rule")]
impl Mul for Jet<'_> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self::build(
            self.v * other.v,
            || self.d * other.v + self.v * other.d,
            |_| self.a * other.v + self.two() * (self.d * other.d) + self.v * other.a,
        )
    }
}

#[expect(clippy::suspicious_arithmetic_impl, reason = "the derivatives of a quotient")]
impl Div for Jet<'_> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.v / other.v;
        Self::build(
            quotient,
            || (self.d - quotient * other.d) / other.v,
            |d| (self.a - self.two() * (d * other.d) - quotient * other.a) / other.v,
        )
    }
}

/// Numbers that an equation can be written in: jets on a record, or values with their slopes.
pub(super) trait Calculus:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number itself.
    fn value(self) -> f64;
    /// Cosine and sine.
    fn cos_sin(self) -> [Self; 2];
    /// Square root.
    fn sqrt(self) -> Self;
    /// Direction of the vector (x, `self`).
    fn atan2(self, x: Self) -> Self;
    /// The same angle in (−π, π].
    fn wrapped(self) -> Self;
}

impl Calculus for Jet<'_> {
    fn value(self) -> f64 {
        self.v.value
    }

    fn cos_sin(self) -> [Self; 2] {
        let [cos, sin] = self.v.cos_sin();
        [
            Self::build(cos, || -(sin * self.d), |_| -(sin * self.a) - cos * (self.d * self.d)),
            Self::build(sin, || cos * self.d, |_| cos * self.a - sin * (self.d * self.d)),
        ]
    }

    fn sqrt(self) -> Self {
        let root = self.v.sqrt();
        let twice = root * self.two();
        Self::build(root, || self.d / twice, |d| (self.a - self.two() * (d * d)) / twice)
    }

    fn atan2(self, x: Self) -> Self {
        let y = self;
        let square = || x.v * x.v + y.v * y.v;
        let half_rise = || x.v * x.d + y.v * y.d;
        Self::build(
            y.v.atan2(x.v),
            || (x.v * y.d - y.v * x.d) / square(),
            |d| (x.v * y.a - y.v * x.a - self.two() * d * half_rise()) / square(),
        )
    }

    fn wrapped(self) -> Self {
        Self { v: self.v.wrapped(), ..self }
    }
}

/// A plane vector of jets.
pub(super) type Vector<'t> = [Jet<'t>; 2];

/// Sum of two vectors.
pub(super) fn plus<T: Calculus>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Difference of two vectors.
pub(super) fn minus<T: Calculus>(a: [T; 2], b: [T; 2]) -> [T; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// Scalar product.
pub(super) fn dot<T: Calculus>(a: [T; 2], b: [T; 2]) -> T {
    a[0] * b[0] + a[1] * b[1]
}

/// A vector turned by a quarter turn, ccw.
pub(super) fn quarter<T: Calculus>(a: [T; 2]) -> [T; 2] {
    [-a[1], a[0]]
}

/// A vector turned by an angle, ccw.
pub(super) fn turned<T: Calculus>(a: [T; 2], angle: T) -> [T; 2] {
    let [cos, sin] = angle.cos_sin();
    [cos * a[0] - sin * a[1], sin * a[0] + cos * a[1]]
}
