//! Random chains of a crank and dyads with the truth about their ends, by geometry of their own: each pin by the
//! foot of the chord, its motion from the two equations that say that its distances do not change. Written once
//! and computed in double-double or in 75 digits.

use std::fmt::Write;

use linkgram::board::Real;
use linkgram::double_double::DoubleDouble;
use linkgram::wide::Wide;

use super::dice::Dice;
use crate::common::exact::Exact;

/// An arithmetic that reads decimals to all its digits.
pub(crate) trait Digits: Real {
    /// A number as its decimals say.
    fn decimal(text: &str) -> Self;
    /// π.
    fn pi() -> Self;
}

impl Digits for DoubleDouble {
    fn decimal(text: &str) -> Self {
        Self::parse(text).unwrap()
    }

    fn pi() -> Self {
        Wide::PI.to_double_double()
    }
}

impl Digits for Wide {
    fn decimal(text: &str) -> Self {
        let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let mut exponent: i32 = exponent.parse().unwrap();
        let mut value = Self::ZERO;
        let ten = Self::of(10.0);
        let mut after_point = false;
        for c in mantissa.trim_start_matches('-').chars() {
            match c.to_digit(10) {
                Some(digit) => {
                    value = value * ten + Self::of(f64::from(digit));
                    exponent -= i32::from(after_point);
                }
                None => after_point = true,
            }
        }
        for _ in 0..exponent.abs() {
            value = if exponent < 0 { value / ten } else { value * ten };
        }
        if mantissa.starts_with('-') { -value } else { value }
    }

    fn pi() -> Self {
        Self::PI
    }
}

type Xy<R> = [R; 2];

fn plus<R: Real>(a: Xy<R>, b: Xy<R>) -> Xy<R> {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus<R: Real>(a: Xy<R>, b: Xy<R>) -> Xy<R> {
    [a[0] - b[0], a[1] - b[1]]
}

fn times<R: Real>(a: Xy<R>, by: R) -> Xy<R> {
    [a[0] * by, a[1] * by]
}

fn dot<R: Real>(a: Xy<R>, b: Xy<R>) -> R {
    a[0] * b[0] + a[1] * b[1]
}

fn cross<R: Real>(a: Xy<R>, b: Xy<R>) -> R {
    a[0] * b[1] - a[1] * b[0]
}

fn near<R: Real>(a: Xy<R>) -> [f64; 2] {
    a.map(Real::to_f64)
}

/// A moving pin: place, velocity, acceleration; millimetres.
#[derive(Clone, Copy)]
struct Pin<R> {
    at: Xy<R>,
    v: Xy<R>,
    a: Xy<R>,
}

/// What finds the next pin from the last one; the numbers stand in [`Chain::numbers`].
#[derive(Debug, Clone, Copy)]
enum Dyad {
    /// First rod, pivot, second rod; whether the pin lies to the left of the line to the pivot.
    Rods { left: bool },
    /// Rod, a point of the guide, its angle in degrees; whether the pin lies ahead of the foot.
    Guide { ahead: bool },
}

/// Crank, angle in degrees, ω, ε.
const OF_CRANK: usize = 4;
/// The numbers of a dyad.
const OF_DYAD: usize = 4;

/// A random chain.
pub(crate) struct Chain {
    /// The scene.
    pub(crate) text: String,
    /// With the frame and the blocks.
    pub(crate) links: usize,
    /// The flattest crossing on the way: the sine of its angle.
    pub(crate) flat: f64,
    /// One crossing was made as flat as it likes.
    pub(crate) is_near_singular: bool,
    /// Whether it closes at all.
    pub(crate) closes: bool,
    dyads: Vec<Dyad>,
    /// Its numbers, as they are written.
    numbers: Vec<String>,
}

/// Place, velocity and acceleration of the last pin, ω and ε of the last rod; metres and radians.
pub(crate) type Truth<R> = [Vec<R>; 5];

/// The quantities of a [`Truth`].
pub(crate) const QUANTITIES: usize = 5;

impl Chain {
    /// The truth; `None` where the chain does not close.
    pub(crate) fn truth<R: Digits>(&self) -> Option<Truth<R>> {
        let numbers: Vec<R> = self.numbers.iter().map(|text| R::decimal(text)).collect();
        truth(&self.dyads, &numbers)
    }

    /// What a relative error of one in each of its numbers does to each quantity, to first order: the sum of the
    /// sizes, by moving one number after the other.
    pub(crate) fn conditioning(&self) -> Option<[f64; QUANTITIES]> {
        /// Far below the distance of any answered position from its dead centre, far above the arithmetic.
        const STEP: f64 = 1e-20;
        let numbers: Vec<DoubleDouble> = self.numbers.iter().map(|n| DoubleDouble::decimal(n)).collect();
        let middle = truth(&self.dyads, &numbers)?;
        let mut sums = middle.clone().map(|parts| vec![0.0; parts.len()]);
        for index in 0..numbers.len() {
            let mut moved = numbers.clone();
            moved[index] = moved[index] + moved[index] * DoubleDouble::of(STEP);
            let after = truth(&self.dyads, &moved)?;
            for (sums, (before, after)) in sums.iter_mut().zip(middle.iter().zip(&after)) {
                for (sum, (before, after)) in sums.iter_mut().zip(before.iter().zip(after)) {
                    *sum += ((*after - *before).to_f64() / STEP).abs();
                }
            }
        }
        Some(sums.map(|parts| parts.into_iter().fold(0.0, libm::hypot)))
    }
}

fn truth<R: Digits>(dyads: &[Dyad], numbers: &[R]) -> Option<Truth<R>> {
    let mut pin = crank(numbers[..OF_CRANK].try_into().unwrap());
    let mut rod = [numbers[2], numbers[3]];
    for (dyad, numbers) in dyads.iter().zip(numbers[OF_CRANK..].chunks_exact(OF_DYAD)) {
        (pin, rod) = next(pin, *dyad, numbers.try_into().unwrap())?;
    }
    let thousand = R::from_f64(1000.0);
    let si = |xy: Xy<R>| xy.map(|c| c / thousand).to_vec();
    Some([si(pin.at), si(pin.v), si(pin.a), vec![rod[0]], vec![rod[1]]])
}

fn radians<R: Digits>(degrees: R) -> R {
    degrees * R::pi() / R::from_f64(180.0)
}

fn crank<R: Digits>([length, degrees, w, e]: [R; OF_CRANK]) -> Pin<R> {
    let (sin, cos) = radians(degrees).sin_cos();
    let arm = times([cos, sin], length);
    let turned = [-arm[1], arm[0]];
    Pin { at: arm, v: times(turned, w), a: minus(times(turned, e), times(arm, w * w)) }
}

/// The next pin, and ω and ε of the rod to it.
fn next<R: Digits>(pin: Pin<R>, dyad: Dyad, numbers: [R; OF_DYAD]) -> Option<(Pin<R>, [R; 2])> {
    let next = match dyad {
        Dyad::Rods { left } => two_rods(pin, left, numbers),
        Dyad::Guide { ahead } => rod_and_guide(pin, ahead, numbers),
    }?;
    let (arm, v, a) = (minus(next.at, pin.at), minus(next.v, pin.v), minus(next.a, pin.a));
    let square = dot(arm, arm);
    Some((next, [cross(arm, v) / square, cross(arm, a) / square]))
}

fn two_rods<R: Digits>(pin: Pin<R>, left: bool, [r3, gx, gy, r4]: [R; OF_DYAD]) -> Option<Pin<R>> {
    let centre = [gx, gy];
    let d = minus(centre, pin.at);
    let square = dot(d, d);
    let along = (square + (r3 - r4) * (r3 + r4)) / (R::from_f64(2.0) * square);
    // 16 F² by differences: no cancellation where the triangle is a needle.
    let reach = square.sqrt();
    let (sum, gap) = (r3 + r4, r3 - r4);
    let sixteen = (sum - reach) * (sum + reach) * (reach - gap) * (reach + gap);
    if sixteen.to_f64() <= 0.0 {
        return None;
    }
    let half = sixteen.sqrt() / (R::from_f64(2.0) * square);
    let arm = plus(times(d, along), times([-d[1], d[0]], if left { half } else { -half }));
    let at = plus(pin.at, arm);
    let other = minus(at, centre);
    // (P − A)·(v − v_A) = 0 and (P − G)·v = 0; then the same once more.
    let solve = |one: R, two: R| {
        let det = cross(arm, other);
        [(one * other[1] - two * arm[1]) / det, (arm[0] * two - other[0] * one) / det]
    };
    let v = solve(dot(arm, pin.v), R::from_f64(0.0));
    let slip = minus(v, pin.v);
    let a = solve(dot(arm, pin.a) - dot(slip, slip), -dot(v, v));
    Some(Pin { at, v, a })
}

fn rod_and_guide<R: Digits>(pin: Pin<R>, ahead: bool, [r, x, y, degrees]: [R; OF_DYAD]) -> Option<Pin<R>> {
    let (sin, cos) = radians(degrees).sin_cos();
    let along = [cos, sin];
    let off = cross(along, minus(pin.at, [x, y]));
    let square = (r - off) * (r + off);
    if square.to_f64() <= 0.0 {
        return None;
    }
    let foot = minus(pin.at, times([-sin, cos], off));
    let half = square.sqrt();
    let at = plus(foot, times(along, if ahead { half } else { -half }));
    let arm = minus(at, pin.at);
    let v = times(along, dot(arm, pin.v) / dot(arm, along));
    let slip = minus(v, pin.v);
    let a = times(along, (dot(arm, pin.a) - dot(slip, slip)) / dot(arm, along));
    Some(Pin { at, v, a })
}

/// Of the chains; of all scenes, of which they are three quarters, a tenth.
const NEAR_SINGULAR: f64 = 0.1 * 4.0 / 3.0;

/// A number with few decimals, or to the last digit.
fn written(value: f64, exact: bool) -> String {
    if exact { format!("{value:e}") } else { format!("{value:.4}") }
}

struct Maker {
    dice: Dice,
    fixed: String,
    links: String,
    slides: String,
    hints: String,
    next: u32,
}

impl Maker {
    /// Writes a link of two joints; its number.
    fn link(&mut self, joints: [&str; 2], length: &str) -> u32 {
        let number = self.next;
        self.next += 1;
        let [a, b] = joints;
        let _ = write!(self.links, r#", "{number}": {{ "joins": ["{a}", "{b}"], "length": {length} }}"#);
        number
    }

    /// Two rods: from the pin at `a`, and from a pivot; the sine between them is `height`. The number of the first.
    fn two_rods(&mut self, index: usize, a: [f64; 2], height: f64, exact: bool) -> Made {
        let (length, toward) =
            (self.dice.between(60.0, 150.0), self.dice.between(0.0, std::f64::consts::TAU));
        let at = |from: [f64; 2], angle: f64, l: f64| {
            [from[0] + l * libm::cos(angle), from[1] + l * libm::sin(angle)]
        };
        let p = at(a, toward, length);
        // The pivot lies where the second rod makes the wanted angle with the first, stretched or folded.
        let second = self.dice.between(0.6, 1.6) * length;
        let bend = libm::asin(height) * self.dice.side();
        let back = if self.dice.chance(0.5) { toward } else { toward + std::f64::consts::PI };
        let g = at(p, back + bend, second).map(|x| (x * 1e4).round() / 1e4);
        let names = [format!("P{index}"), format!("P{}", index + 1), format!("G{}", index + 1)];
        let [from, to, pivot] = [names[0].as_str(), names[1].as_str(), names[2].as_str()];
        // The second length closes the chain: to four decimals, or to the last digit.
        let d = [g[0] - a[0], g[1] - a[1]];
        let reach = libm::hypot(d[0], d[1]);
        let along = ((p[0] - a[0]) * d[0] + (p[1] - a[1]) * d[1]) / reach;
        let closing = (length * length - 2.0 * along * reach + reach * reach).max(0.0).sqrt();
        let [r3, r4] = [written(length, false), written(closing, exact)];
        let centre = g.map(|x| written(x, false));
        let _ = write!(self.fixed, r#", "{pivot}": [{}, {}]"#, centre[0], centre[1]);
        let number = self.link([from, to], &r3);
        self.link([pivot, to], &r4);
        let left = d[0] * (p[1] - a[1]) - d[1] * (p[0] - a[0]) > 0.0;
        let [x, y] = centre;
        Made { dyad: Dyad::Rods { left }, numbers: [r3, x, y, r4], rod: number }
    }

    /// A rod from the pin at `a` to a block on a fixed guide.
    fn rod_and_guide(&mut self, index: usize, a: [f64; 2], height: f64, exact: bool) -> Made {
        let (length, toward) =
            (self.dice.between(60.0, 150.0), self.dice.between(0.0, std::f64::consts::TAU));
        let p = [a[0] + length * libm::cos(toward), a[1] + length * libm::sin(toward)];
        // The guide makes an angle with the rod whose cosine is the height: at a right angle it is at its end.
        let guide = toward + libm::acos(height) * self.dice.side();
        let degrees = written(guide.to_degrees(), exact);
        let [x, y] = p.map(|x| written(x, exact));
        let names = [format!("P{index}"), format!("P{}", index + 1)];
        let r = written(length, exact);
        let number = self.link([&names[0], &names[1]], &r);
        let comma = if self.slides.is_empty() { "" } else { ", " };
        let block = self.next;
        self.next += 1;
        let _ = write!(
            self.slides,
            r#"{comma}{{ "pin": "{}", "block": {block}, "on": {{ "link": 1, "through": [{x}, {y}], "angle": {degrees} }} }}"#,
            names[1]
        );
        let (sin, cos) = libm::sincos(guide);
        let ahead = (p[0] - a[0]) * cos + (p[1] - a[1]) * sin > 0.0;
        Made { dyad: Dyad::Guide { ahead }, numbers: [r, x, y, degrees], rod: number }
    }
}

struct Made {
    dyad: Dyad,
    numbers: [String; OF_DYAD],
    rod: u32,
}

/// The chain of this number: 4 to 200 links, mostly few; a tenth of them with one crossing as flat as they like.
pub(crate) fn chain(seed: u64) -> Chain {
    let mut dice = Dice::new(seed);
    let dyads = match dice.roll() {
        p if p < 0.7 => dice.between(1.0, 4.0),
        p if p < 0.95 => dice.between(4.0, 11.0),
        p if p < 0.995 => dice.between(11.0, 31.0),
        _ => dice.between(31.0, 100.0),
    } as usize;
    let singular =
        dice.chance(NEAR_SINGULAR).then(|| (dice.between(0.0, dyads as f64) as usize).min(dyads - 1));
    let length = format!("{:.3}", dice.between(20.0, 80.0));
    let angle = format!("{:.4}", dice.between(0.0, 360.0));
    let omega = format!("{:.3}", dice.between(0.5, 40.0) * dice.side());
    let alpha = if dice.chance(0.3) { "0".to_owned() } else { format!("{:.2}", dice.between(-300.0, 300.0)) };
    let mut maker = Maker {
        dice,
        fixed: r#""O": [0, 0]"#.to_owned(),
        links: format!(r#""2": {{ "joins": ["O", "P0"], "length": {length} }}"#),
        slides: String::new(),
        hints: String::new(),
        next: 3,
    };
    let input = format!(r#"{{ "link": 2, "angle": {angle}, "omega": {omega}, "alpha": {alpha} }}"#);
    let mut numbers = vec![length, angle, omega, alpha];
    let mut pin = crank([0, 1, 2, 3].map(|i: usize| DoubleDouble::decimal(&numbers[i])));
    let (mut flat, mut closes, mut last) = (1.0_f64, true, 2);
    let mut made_dyads = Vec::new();
    for index in 0..dyads {
        let exact = singular == Some(index);
        // The sine of the angle at which the arcs, or rod and guide, cross.
        let height = if exact {
            libm::pow(10.0, -maker.dice.between(1.0, 14.0))
        } else {
            maker.dice.between(0.35, 0.95)
        };
        let made = if maker.dice.chance(0.6) {
            maker.two_rods(index, near(pin.at), height, exact)
        } else {
            maker.rod_and_guide(index, near(pin.at), height, exact)
        };
        flat = flat.min(height);
        last = made.rod;
        let after = [0, 1, 2, 3].map(|i: usize| DoubleDouble::decimal(&made.numbers[i]));
        numbers.extend(made.numbers);
        made_dyads.push(made.dyad);
        let Some((next, _)) = next(pin, made.dyad, after) else {
            closes = false;
            break;
        };
        let [x, y] = near(next.at);
        let comma = if index > 0 { ", " } else { "" };
        let _ = write!(maker.hints, r#"{comma}"P{}": [{x:e}, {y:e}]"#, index + 1);
        pin = next;
    }
    let end = if closes { format!("P{dyads}") } else { "P0".to_owned() };
    let Maker { fixed, links, slides, hints, .. } = maker;
    let text = format!(
        r#"{{ "units": {{ "length": "mm" }}, "fixed": {{ {fixed} }}, "links": {{ {links} }},
             "slides": [{slides}], "near": {{ {hints} }}, "input": {input},
             "find": ["x({end})", "v({end})", "a({end})", "omega({last})", "alpha({last})"] }}"#
    );
    Chain {
        text,
        links: 2 * dyads + 2,
        flat,
        is_near_singular: singular.is_some(),
        closes,
        dyads: made_dyads,
        numbers,
    }
}

#[test]
fn decimals_are_read_to_all_digits() {
    let off = |text: &str| (Exact::wide(Wide::decimal(text)) - Exact::decimal(text)).abs().near();
    assert!(off("-12.5e-1") <= Wide::ROUNDOFF && off("0.1") <= Wide::ROUNDOFF);
    assert!((Wide::decimal("0.1") - Wide::of(0.1)).abs().to_f64() > 1e-18);
}
