//! Units, and numbers that carry them.

use std::f64::consts::{FRAC_PI_2, PI};

use super::Units;
use super::diagnostic::{Fault, Res};
use super::json::{Fields, Kind, Value};
use super::keys;
use crate::double_double::DoubleDouble;
pub(crate) use crate::mechanism::quantity::Measure;
use crate::mechanism::quantity::Unit;
use crate::mechanism::{Given, Sense};

/// Half a unit in the last place, relative.
const HALF_ULP: f64 = f64::EPSILON / 2.0;
/// No mechanism is larger or faster in SI units; below it, products of several quantities stay finite.
const LARGEST: f64 = 1e60;
/// No mechanism is smaller or slower, unless it is zero.
const SMALLEST: f64 = 1e-60;

/// Exponents of mass, length, time and angle. Angles count as a dimension of their own, so that a frequency
/// or a length cannot pass for one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Dimension {
    mass: i8,
    length: i8,
    time: i8,
    angle: i8,
}

impl Dimension {
    const fn new(length: i8, time: i8, angle: i8) -> Self {
        Self { mass: 0, length, time, angle }
    }

    /// One mass with these.
    const fn heavy(length: i8, time: i8, angle: i8) -> Self {
        Self { mass: 1, length, time, angle }
    }

    /// With its article.
    fn noun(self) -> String {
        match Measure::ALL.iter().find(|m| m.dimension() == self) {
            Some(measure) => measure.noun().to_owned(),
            None if self == Self::new(0, 1, 0) => "a time".to_owned(),
            None => "no quantity of a mechanism".to_owned(),
        }
    }
}

/// An angle whose last digit leaves more than this open (radians) points nowhere.
const OPEN_ANGLE: f64 = 1.0 / 8.0;

impl Measure {
    const ALL: [Self; 16] = [
        Self::Length,
        Self::Angle,
        Self::Velocity,
        Self::Acceleration,
        Self::AngularVelocity,
        Self::AngularAcceleration,
        Self::Number,
        Self::Force,
        Self::Mass,
        Self::Torque,
        Self::Inertia,
        Self::Stiffness,
        Self::TurningStiffness,
        Self::Pressure,
        Self::Power,
        Self::Area,
    ];

    pub(crate) const fn dimension(self) -> Dimension {
        match self {
            Self::Length => Dimension::new(1, 0, 0),
            Self::Angle => Dimension::new(0, 0, 1),
            Self::Velocity => Dimension::new(1, -1, 0),
            Self::Acceleration => Dimension::new(1, -2, 0),
            Self::AngularVelocity => Dimension::new(0, -1, 1),
            Self::AngularAcceleration => Dimension::new(0, -2, 1),
            Self::Number => Dimension::new(0, 0, 0),
            Self::Force => Dimension::heavy(1, -2, 0),
            Self::Mass => Dimension::heavy(0, 0, 0),
            Self::Torque => Dimension::heavy(2, -2, 0),
            Self::Inertia => Dimension::heavy(2, 0, 0),
            Self::Stiffness => Dimension::heavy(0, -2, 0),
            Self::TurningStiffness => Dimension::heavy(2, -2, -1),
            Self::Pressure => Dimension::heavy(-1, -2, 0),
            Self::Power => Dimension::heavy(2, -3, 0),
            Self::Area => Dimension::new(2, 0, 0),
        }
    }

    pub(crate) const fn noun(self) -> &'static str {
        match self {
            Self::Length => "a length",
            Self::Angle => "an angle",
            Self::Velocity => "a velocity",
            Self::Acceleration => "an acceleration",
            Self::AngularVelocity => "an angular velocity",
            Self::AngularAcceleration => "an angular acceleration",
            Self::Number => "a number without unit",
            Self::Force => "a force",
            Self::Mass => "a mass",
            Self::Torque => "a torque",
            Self::Inertia => "a moment of inertia",
            Self::Stiffness => "a stiffness",
            Self::TurningStiffness => "the stiffness of a torsion spring",
            Self::Pressure => "a pressure",
            Self::Power => "a power",
            Self::Area => "an area",
        }
    }

    /// A unit that would be right.
    const fn example(self) -> &'static str {
        match self {
            Self::Length => "cm",
            Self::Angle => "deg",
            Self::Velocity => "cm/s",
            Self::Acceleration => "cm/s^2",
            Self::AngularVelocity => "rad/s",
            Self::AngularAcceleration => "rad/s^2",
            Self::Number => "",
            Self::Force => "N",
            Self::Mass => "kg",
            Self::Torque => "N*m",
            Self::Inertia => "kg*m^2",
            Self::Stiffness => "N/m",
            Self::TurningStiffness => "N*m/rad",
            Self::Pressure => "bar",
            Self::Power => "W",
            Self::Area => "mm^2",
        }
    }

    /// Whether `cw` and `ccw` say something about it anywhere.
    pub(crate) const fn turns(self) -> bool {
        matches!(self, Self::Angle | Self::AngularVelocity | Self::AngularAcceleration | Self::Torque)
    }
}

/// A unit as a quotient of two numbers, exact wherever π has no part in it: a division by a power of
/// ten rounds once, a multiplication by 0.01 twice.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Scale {
    pub(crate) symbol: String,
    dimension: Dimension,
    numerator: f64,
    denominator: f64,
    /// Relative error of the quotient.
    error: f64,
    /// The quotient to double-double.
    fine: DoubleDouble,
    /// Relative error of `fine`.
    fine_error: f64,
    /// How many units make a full turn, for the units in which that is exact.
    turn: Option<f64>,
}

/// Symbol, dimension, numerator, denominator, relative error.
type Row = (&'static str, Dimension, f64, f64, f64);

const LENGTH: Dimension = Measure::Length.dimension();
const TIME: Dimension = Dimension::new(0, 1, 0);
const ANGLE: Dimension = Measure::Angle.dimension();

const FORCE: Dimension = Measure::Force.dimension();
const MASS: Dimension = Measure::Mass.dimension();
const WORK: Dimension = Measure::Torque.dimension();
const POWER: Dimension = Measure::Power.dimension();
const PRESSURE: Dimension = Measure::Pressure.dimension();

/// A pound-force is this over 10¹³ newtons, exactly.
const POUND_FORCE: f64 = 44_482_216_152_605.0;

const TABLE: [Row; 37] = [
    ("nm", LENGTH, 1.0, 1e9, 0.0),
    ("um", LENGTH, 1.0, 1e6, 0.0),
    ("mm", LENGTH, 1.0, 1e3, 0.0),
    ("cm", LENGTH, 1.0, 1e2, 0.0),
    ("m", LENGTH, 1.0, 1.0, 0.0),
    ("km", LENGTH, 1e3, 1.0, 0.0),
    ("in", LENGTH, 254.0, 1e4, 0.0),
    ("ft", LENGTH, 3048.0, 1e4, 0.0),
    ("ms", TIME, 1.0, 1e3, 0.0),
    ("s", TIME, 1.0, 1.0, 0.0),
    ("min", TIME, 60.0, 1.0, 0.0),
    ("deg", ANGLE, PI, 180.0, HALF_ULP),
    ("rad", ANGLE, 1.0, 1.0, 0.0),
    ("rev", ANGLE, 2.0 * PI, 1.0, HALF_ULP),
    ("rpm", Measure::AngularVelocity.dimension(), PI, 30.0, HALF_ULP),
    ("mN", FORCE, 1.0, 1e3, 0.0),
    ("N", FORCE, 1.0, 1.0, 0.0),
    ("kN", FORCE, 1e3, 1.0, 0.0),
    ("MN", FORCE, 1e6, 1.0, 0.0),
    ("lbf", FORCE, POUND_FORCE, 1e13, 0.0),
    ("kgf", FORCE, 980_665.0, 1e5, 0.0),
    ("g", MASS, 1.0, 1e3, 0.0),
    ("kg", MASS, 1.0, 1.0, 0.0),
    ("t", MASS, 1e3, 1.0, 0.0),
    ("lb", MASS, 45_359_237.0, 1e8, 0.0),
    ("slug", MASS, POUND_FORCE, 3.048e12, 0.0),
    ("J", WORK, 1.0, 1.0, 0.0),
    ("kJ", WORK, 1e3, 1.0, 0.0),
    ("W", POWER, 1.0, 1.0, 0.0),
    ("kW", POWER, 1e3, 1.0, 0.0),
    // 550 ft lbf/s.
    ("hp", POWER, POUND_FORCE / 5.0 * 4191.0, 5e13, HALF_ULP),
    ("Pa", PRESSURE, 1.0, 1.0, 0.0),
    ("kPa", PRESSURE, 1e3, 1.0, 0.0),
    ("MPa", PRESSURE, 1e6, 1.0, 0.0),
    ("GPa", PRESSURE, 1e9, 1.0, 0.0),
    ("bar", PRESSURE, 1e5, 1.0, 0.0),
    // lbf/in².
    ("psi", PRESSURE, POUND_FORCE, 6_451_600_000.0, 0.0),
];

/// Every unit name.
pub(crate) fn names() -> impl Iterator<Item = &'static str> {
    TABLE.iter().map(|row| row.0)
}

fn names_of(dimension: Dimension) -> impl Iterator<Item = &'static str> {
    TABLE.iter().filter(move |row| row.1 == dimension).map(|row| row.0)
}

impl Scale {
    /// One of the table's units.
    fn base(name: &str) -> Option<Self> {
        let &(symbol, dimension, numerator, denominator, error) = TABLE.iter().find(|row| row.0 == name)?;
        let turn = match symbol {
            "deg" => Some(360.0),
            "rev" => Some(1.0),
            _ => None,
        };
        let beyond_a_double = match symbol {
            "deg" | "rpm" => Some(DoubleDouble::PI),
            "rev" => Some(DoubleDouble::PI * DoubleDouble::of(2.0)),
            "hp" => Some(DoubleDouble::of(POUND_FORCE / 5.0) * DoubleDouble::of(4191.0)),
            _ => None,
        };
        let fine = beyond_a_double.unwrap_or(DoubleDouble::of(numerator)) / DoubleDouble::of(denominator);
        Some(Self {
            symbol: symbol.to_owned(),
            dimension,
            numerator,
            denominator,
            error,
            fine,
            fine_error: 2.0 * DoubleDouble::ROUNDOFF,
            turn,
        })
    }

    /// Degrees.
    pub(crate) fn degrees() -> Self {
        Self::base("deg").unwrap_or_else(Self::one)
    }

    /// The number 1, to begin a product with.
    fn one() -> Self {
        Self {
            symbol: String::new(),
            dimension: Dimension::new(0, 0, 0),
            numerator: 1.0,
            denominator: 1.0,
            error: 0.0,
            fine: DoubleDouble::of(1.0),
            fine_error: 0.0,
            turn: None,
        }
    }

    /// The product with another unit, or the quotient.
    fn combine(&self, other: &Self, inverse: bool) -> Option<Self> {
        let sign: i8 = if inverse { -1 } else { 1 };
        let add = |a: i8, b: i8| a.checked_add(b.checked_mul(sign)?);
        let (up, down) =
            if inverse { (other.denominator, other.numerator) } else { (other.numerator, other.denominator) };
        // A product of whole numbers below 2^53 is exact.
        let exact = |a: f64, b: f64| {
            let p = a * b;
            a == 1.0 || b == 1.0 || (a.fract() == 0.0 && b.fract() == 0.0 && p < 9e15)
        };
        let rounding = |a, b| if exact(a, b) { 0.0 } else { HALF_ULP };
        Some(Self {
            symbol: String::new(),
            dimension: Dimension {
                mass: add(self.dimension.mass, other.dimension.mass)?,
                length: add(self.dimension.length, other.dimension.length)?,
                time: add(self.dimension.time, other.dimension.time)?,
                angle: add(self.dimension.angle, other.dimension.angle)?,
            },
            numerator: self.numerator * up,
            denominator: self.denominator * down,
            error: self.error + other.error + rounding(self.numerator, up) + rounding(self.denominator, down),
            fine: if inverse { self.fine / other.fine } else { self.fine * other.fine },
            fine_error: self.fine_error + other.fine_error + DoubleDouble::ROUNDOFF,
            turn: None,
        })
    }

    /// Reads `cm`, `rad/s^2`, `m*rad/s`, and `N·m` as sheets print it.
    pub(crate) fn parse(text: &str, at: usize) -> Res<Self> {
        let wrong = |what: String| Fault::new(at, what);
        let text = text.trim().replace(DOTS, "*");
        let text = text.as_str();
        if let Some(base) = Self::base(text) {
            return Ok(base);
        }
        if text.strip_prefix(',').is_some_and(|rest| rest.starts_with(|sign: char| sign.is_ascii_digit())) {
            return Err(wrong("a number with a decimal comma".to_owned()).mend("write a decimal point: 3.5"));
        }
        let mut unit = Self::one();
        let mut inverse = false;
        let mut rest = text;
        loop {
            let end = rest.find(['/', '*']).unwrap_or(rest.len());
            let (name, power) = power(rest[..end].trim()).ok_or_else(|| {
                wrong(format!("`{text}` is not a unit: an exponent is a digit from 1 to 9"))
            })?;
            let base = Self::base(name).ok_or_else(|| {
                let what = if name == text { String::new() } else { format!("`{text}` is not a unit: ") };
                let fault = if name.is_empty() {
                    wrong(format!("`{text}` is not a unit"))
                } else {
                    wrong(format!("{what}`{name}` is not a unit"))
                };
                match as_elsewhere(name, text) {
                    Some(ours) => fault.mend(format!("write `{ours}`")),
                    None => fault.known(name, names()),
                }
            })?;
            for _ in 0..power {
                let product = unit.combine(&base, inverse);
                unit = product.ok_or_else(|| wrong(format!("`{text}` has too many factors")))?;
            }
            match rest[end..].chars().next() {
                Some(sign) => inverse = sign == '/',
                None => break,
            }
            rest = &rest[end + 1..];
        }
        // An absurd product (nm^9/km^9) has no use and no finite value.
        if !(1e-30..=1e30).contains(&unit.si()) {
            return Err(wrong(format!("`{text}` is not a unit of a mechanism's quantity")));
        }
        unit.symbol = spelled(text);
        Ok(unit)
    }

    /// The unit as the other rooms know it.
    pub(crate) fn unit(&self) -> Unit {
        Unit { symbol: self.symbol.clone(), si: self.si() }
    }

    /// What it measures.
    pub(crate) fn dimension(&self) -> Dimension {
        self.dimension
    }

    /// SI units per unit.
    pub(crate) fn si(&self) -> f64 {
        self.numerator / self.denominator
    }

    /// Refuses a unit of another dimension.
    pub(crate) fn must_be(self, measure: Measure, at: usize) -> Res<Self> {
        if self.dimension == measure.dimension() {
            return Ok(self);
        }
        let (symbol, is) = (&self.symbol, self.dimension.noun());
        if measure == Measure::Force && self.dimension == MASS {
            let what = format!("`{symbol}` measures a mass, and a force is expected here");
            return Err(Fault::new(at, what).mend("take a unit of force such as `N`, `lbf` or `kgf`"));
        }
        if measure == Measure::Mass && self.dimension == FORCE {
            let what = format!("`{symbol}` measures a force, and a mass is expected here");
            return Err(Fault::new(at, what).mend("give it as `weight`, or take a unit such as `kg`"));
        }
        let what = format!("`{symbol}` measures {is}, but {} is expected here", measure.noun());
        Err(Fault::new(at, what).mend(format!("take a unit such as `{}`", measure.example())))
    }

    /// A number of this unit in SI.
    fn apply(&self, read: Given) -> Given {
        if let Some(turn) = self.turn {
            return self.angle(read, turn);
        }
        let up = if self.numerator == 1.0 { 0.0 } else { HALF_ULP };
        let down = if self.denominator == 1.0 { 0.0 } else { HALF_ULP };
        let value = read.value * self.numerator / self.denominator;
        let error = read.error * self.si() + value.abs() * (self.error + up + down);
        self.refined(value, error, read.double_double(), read.low_error)
    }

    /// A number of this unit as an angle with all its turns; quarter turns are the doubles nearest to their values.
    fn whole_angle(&self, read: Given) -> Given {
        let quarters = self.turn.map_or(0.5, |turn| read.value / (turn / 4.0));
        let (value, rounding) = if quarters.fract() == 0.0 {
            (quarters * FRAC_PI_2, HALF_ULP)
        } else {
            (read.value * self.numerator / self.denominator, self.error + 2.0 * HALF_ULP)
        };
        let error = read.error * self.si() + value.abs() * rounding;
        self.refined(value, error, read.double_double(), read.low_error)
    }

    /// A converted number with what its nearest double leaves.
    fn refined(&self, value: f64, error: f64, read: DoubleDouble, read_error: f64) -> Given {
        let fine = read * self.fine;
        let low_error = read_error * self.si() + value.abs() * (self.fine_error + DoubleDouble::ROUNDOFF);
        Given { value, error, low: fine.hi() - value + fine.lo(), low_error }
    }

    /// An angle within half a turn. Whole turns are taken off in the unit itself, where that is exact,
    /// and quarter turns are the double nearest to their value.
    fn angle(&self, read: Given, turn: f64) -> Given {
        let mut rest = libm::fmod(read.value, turn);
        if rest > turn / 2.0 {
            rest -= turn;
        } else if rest <= -turn / 2.0 {
            rest += turn;
        }
        let quarters = rest / (turn / 4.0);
        let (value, rounding) = if quarters.fract() == 0.0 {
            (quarters * FRAC_PI_2, HALF_ULP)
        } else {
            (rest * self.numerator / self.denominator, self.error + 2.0 * HALF_ULP)
        };
        let error = read.error * self.si() + value.abs() * rounding;
        // What was taken off is a whole number of turns exactly: the low part stays as it is.
        self.refined(value, error, DoubleDouble::sum(rest, read.low), read.low_error)
    }
}

/// How a product of units is printed.
const DOTS: [char; 2] = ['\u{b7}', '\u{22c5}'];

/// SI units per unit, to double-double: from the unit's symbol, since a double would round it.
#[must_use]
pub fn si_of(unit: &Unit) -> DoubleDouble {
    Scale::parse(&unit.symbol, 0).map_or(DoubleDouble::of(unit.si), |scale| scale.fine)
}

/// `s^2`, `s²` or `s2` as `s` and 2.
fn power(factor: &str) -> Option<(&str, u32)> {
    if let Some(name) = factor.strip_suffix('²') {
        return Some((name.trim_end(), 2));
    }
    let exponent = |digits: &str| match digits.trim().as_bytes() {
        [digit @ b'1'..=b'9'] => Some(u32::from(digit - b'0')),
        _ => None,
    };
    match factor.split_once('^') {
        Some((name, digits)) => Some((name.trim_end(), exponent(digits)?)),
        // No unit ends in a digit, so that one after a unit is its power.
        None => {
            let name = factor.trim_end_matches(|c: char| c.is_ascii_digit());
            let known = name != factor && Scale::base(name).is_some();
            Some(if known { (name, exponent(&factor[name.len()..])?) } else { (factor, 1) })
        }
    }
}

/// A unit with its powers written `s^2`, whichever way somebody wrote them.
fn spelled(text: &str) -> String {
    let mut symbol = String::new();
    for part in text.split_inclusive(['/', '*']) {
        let (factor, sign) = match part.strip_suffix(['/', '*']) {
            Some(factor) => (factor, &part[factor.len()..]),
            None => (part, ""),
        };
        match power(factor.trim()) {
            Some((name, exponent @ 2..)) => symbol.push_str(&format!("{name}^{exponent}")),
            Some((name, _)) => symbol.push_str(name),
            None => symbol.push_str(factor),
        }
        symbol.push_str(sign);
    }
    symbol
}

/// The units of bare numbers.
#[derive(Debug, Clone)]
pub(crate) struct Scales {
    length: Scale,
    angle: Scale,
    velocity: Scale,
    acceleration: Scale,
    angular_velocity: Scale,
    angular_acceleration: Scale,
    number: Scale,
    time: Scale,
    force: Scale,
    mass: Scale,
    torque: Scale,
    inertia: Scale,
    stiffness: Scale,
    turning_stiffness: Scale,
    pressure: Scale,
    power: Scale,
    area: Scale,
}

/// A number with its unit, as stated.
#[derive(Debug, Clone)]
pub(crate) struct Stated {
    /// In SI units, sense applied.
    pub(crate) given: Given,
    /// The unit in which it was stated.
    pub(crate) scale: Scale,
    /// Whether `cw` or `ccw` was said.
    pub(crate) sense: Option<Sense>,
}

impl Scales {
    /// Reads `units`; what is not said is as in `otherwise`, or SI and degrees.
    pub(crate) fn read(value: Option<&Value<'_>>, otherwise: Option<&Units>) -> Res<Self> {
        let fields = value.map(|v| Fields::of(v, keys::UNITS, "units by what they measure")).transpose()?;
        let choose = |key: &str, default: &str, dimension: Dimension| -> Res<Scale> {
            let value = fields.as_ref().and_then(|f| f.get(key));
            let (name, at) = match value {
                Some(value) => (value.text("the name of a unit")?.trim(), value.at),
                None => (default, 0),
            };
            Scale::base(name).filter(|scale| scale.dimension == dimension).ok_or_else(|| {
                Fault::new(at, format!("`{name}` is not a unit of {key}")).known(name, names_of(dimension))
            })
        };
        let default = |unit: fn(&Units) -> &Unit, usual: &'static str| {
            otherwise.map_or(usual, |units| unit(units).symbol.as_str())
        };
        let length = choose("length", default(|u| &u.length, "m"), LENGTH)?;
        let angle = choose("angle", default(|u| &u.angle, "deg"), ANGLE)?;
        let time = choose("time", default(|u| &u.time, "s"), TIME)?;
        // A unit that may be a product of others.
        let compound = |key: &str, default: &str, measure: Measure| -> Res<Scale> {
            match fields.as_ref().and_then(|f| f.get(key)) {
                Some(value) => {
                    Scale::parse(value.text("the name of a unit")?, value.at)?.must_be(measure, value.at)
                }
                None => Scale::parse(default, 0),
            }
        };
        // Of a spring that pulls, or of one that turns: whichever the unit measures.
        let turns = |value: &Value<'_>| -> Res<bool> {
            let unit = Scale::parse(value.text("the name of a unit")?, value.at)?;
            Ok(unit.dimension == Measure::TurningStiffness.dimension())
        };
        let stiffness = fields.as_ref().and_then(|fields| fields.get("stiffness"));
        let (stiffness, turning_stiffness) = match stiffness {
            Some(value) if turns(value)? => {
                let turning = Scale::parse(value.text("the name of a unit")?, value.at)?;
                (Scale::parse(default(|u| &u.stiffness, "N/m"), 0)?, turning)
            }
            _ => {
                let pull = compound("stiffness", default(|u| &u.stiffness, "N/m"), Measure::Stiffness)?;
                (pull, Scale::parse("N*m/rad", 0)?)
            }
        };
        let rad = Scale::base("rad").unwrap_or_else(Scale::one);
        let rate = |of: &Scale, order: u8| {
            let mut scale = of.clone();
            for _ in 0..order {
                // Two dimensions and two orders cannot overflow an exponent.
                scale = scale.combine(&time, true).unwrap_or(scale);
            }
            let power = if order == 2 { "^2" } else { "" };
            scale.symbol = format!("{}/{}{power}", of.symbol, time.symbol);
            scale
        };
        // Two powers of a length cannot overflow an exponent.
        let square = |of: &Scale| {
            let mut scale = of.combine(of, false).unwrap_or_else(|| of.clone());
            scale.symbol = format!("{}^2", of.symbol);
            scale
        };
        Ok(Self {
            velocity: rate(&length, 1),
            acceleration: rate(&length, 2),
            angular_velocity: rate(&rad, 1),
            angular_acceleration: rate(&rad, 2),
            number: Scale::one(),
            force: compound("force", default(|u| &u.force, "N"), Measure::Force)?,
            mass: compound("mass", default(|u| &u.mass, "kg"), Measure::Mass)?,
            torque: compound("torque", default(|u| &u.torque, "N*m"), Measure::Torque)?,
            inertia: compound("inertia", default(|u| &u.inertia, "kg*m^2"), Measure::Inertia)?,
            stiffness,
            turning_stiffness,
            pressure: compound("pressure", default(|u| &u.pressure, "Pa"), Measure::Pressure)?,
            power: compound("power", default(|u| &u.power, "W"), Measure::Power)?,
            area: square(&length),
            length,
            angle,
            time,
        })
    }

    /// The unit of bare numbers.
    pub(crate) fn bare(&self, measure: Measure) -> &Scale {
        match measure {
            Measure::Length => &self.length,
            Measure::Angle => &self.angle,
            Measure::Velocity => &self.velocity,
            Measure::Acceleration => &self.acceleration,
            Measure::AngularVelocity => &self.angular_velocity,
            Measure::AngularAcceleration => &self.angular_acceleration,
            Measure::Number => &self.number,
            Measure::Force => &self.force,
            Measure::Mass => &self.mass,
            Measure::Torque => &self.torque,
            Measure::Inertia => &self.inertia,
            Measure::Stiffness => &self.stiffness,
            Measure::TurningStiffness => &self.turning_stiffness,
            Measure::Pressure => &self.pressure,
            Measure::Power => &self.power,
            Measure::Area => &self.area,
        }
    }

    pub(crate) fn units(&self) -> Units {
        Units {
            length: self.length.unit(),
            angle: self.angle.unit(),
            time: self.time.unit(),
            force: self.force.unit(),
            mass: self.mass.unit(),
            torque: self.torque.unit(),
            inertia: self.inertia.unit(),
            stiffness: self.stiffness.unit(),
            pressure: self.pressure.unit(),
            power: self.power.unit(),
        }
    }

    /// A number without a sense of rotation, unless its measure has one.
    pub(crate) fn given(&self, value: &Value<'_>, measure: Measure) -> Res<Given> {
        Ok(self.stated(value, measure, measure.turns(), self.bare(measure))?.given)
    }

    /// A number with all that was said about it. `senses`: whether `cw` and `ccw` may stand after it;
    /// `bare`: the unit where none is said.
    pub(crate) fn stated(
        &self,
        value: &Value<'_>,
        measure: Measure,
        senses: bool,
        bare: &Scale,
    ) -> Res<Stated> {
        let expected = || format!("{}, a number or text such as \"6 {}\"", measure.noun(), measure.example());
        let stated = match &value.kind {
            Kind::Number(digits) => Ok(Words { digits, unit: "", sense: None }),
            Kind::Text(text) => Words::split(text).ok_or_else(|| {
                Fault::new(value.at, format!("`{text}` does not begin with a number"))
                    .mend(format!("write {}", expected()))
            }),
            _ => Err(value.unexpected(&expected())),
        }?;
        let scale = match stated.unit {
            "" => bare.clone(),
            unit => Scale::parse(unit, value.at)?.must_be(measure, value.at)?,
        };
        if stated.sense.is_some() && !senses {
            let what = format!("{} has no sense of rotation here", measure.noun());
            return Err(
                Fault::new(value.at, what).mend("leave out `cw` or `ccw`, a sign gives the direction")
            );
        }
        let read = number(stated.digits, value.at)?;
        let mut given = scale.apply(read);
        if stated.sense == Some(Sense::Cw) {
            given = -given;
        }
        // A negative zero would print as one.
        given.value += 0.0;
        // Before whole turns are taken off: they may leave nothing.
        let size = (read.value * scale.si()).abs();
        if size > LARGEST || (size < SMALLEST && read.value != 0.0) {
            let what = format!("`{}` is out of range", stated.digits);
            let range = format!("sizes from {SMALLEST:e} to {LARGEST:e} in SI units, and 0, can be solved");
            return Err(Fault::new(value.at, what).mend(range));
        }
        if measure == Measure::Angle && given.error > OPEN_ANGLE {
            let what = format!("`{}` has no digits left for the part of a turn", stated.digits);
            return Err(Fault::new(value.at, what).mend("take whole turns off"));
        }
        Ok(Stated { given, scale, sense: stated.sense })
    }

    /// An angle with all its turns.
    pub(crate) fn whole_angle(&self, value: &Value<'_>) -> Res<Given> {
        let stated = self.stated(value, Measure::Angle, false, self.bare(Measure::Angle))?;
        let digits = match &value.kind {
            Kind::Number(digits) => Some(&**digits),
            Kind::Text(text) => Words::split(text).map(|words| words.digits),
            _ => None,
        };
        let read = digits.map(|digits| number(digits, value.at)).transpose()?;
        Ok(read.map_or(stated.given, |read| stated.scale.whole_angle(read)))
    }

    /// A length greater than zero.
    pub(crate) fn positive(&self, value: &Value<'_>, what: &str) -> Res<Given> {
        let given = self.given(value, Measure::Length)?;
        if given.value > 0.0 {
            return Ok(given);
        }
        let fault = Fault::new(value.at, format!("{what} must be greater than zero"));
        Err(fault.mend("lengths carry no sign: angles and guides give the directions"))
    }

    /// A pair of coordinates.
    pub(crate) fn place(&self, value: &Value<'_>) -> Res<[Given; 2]> {
        match value.list("a place [x, y]")? {
            [x, y] => Ok([self.given(x, Measure::Length)?, self.given(y, Measure::Length)?]),
            other => {
                Err(Fault::new(value.at, format!("expected a place [x, y], found {} numbers", other.len())))
            }
        }
    }

    /// A length in the scene's unit, for a message: seven digits and the unit.
    pub(crate) fn say_length(&self, metres: f64) -> String {
        format!("{} {}", short(metres / self.length.si()), self.length.symbol)
    }

    /// An angle in the scene's unit, for a message.
    pub(crate) fn say_angle(&self, radians: f64) -> String {
        format!("{} {}", short(radians / self.angle.si()), self.angle.symbol)
    }
}

/// Seven significant digits without trailing zeros.
pub(crate) fn short(value: f64) -> String {
    let text = format!("{value:.6e}");
    text.parse::<f64>().map_or(text, |rounded| format!("{rounded}"))
}

/// A number as written in decimals. Infinite, and not zero but too small for a double, are errors.
pub(crate) fn number(digits: &str, at: usize) -> Res<Given> {
    let value: f64 = digits.parse().map_err(|_| Fault::new(at, format!("`{digits}` is not a number")))?;
    let mantissa = digits.split(['e', 'E']).next().unwrap_or_default();
    let vanished = value == 0.0 && mantissa.bytes().any(|b| matches!(b, b'1'..=b'9'));
    if !value.is_finite() || vanished {
        let fault = Fault::new(at, format!("`{digits}` is out of range of double precision"));
        return Err(fault.mend(format!("sizes from {SMALLEST:e} to {LARGEST:e} in SI units can be solved")));
    }
    Ok(Given::decimal(digits).unwrap_or(Given::read(value)))
}

/// `75 rpm cw`, taken apart.
pub(crate) struct Words<'t> {
    pub(crate) digits: &'t str,
    /// Empty where none is said.
    pub(crate) unit: &'t str,
    pub(crate) sense: Option<Sense>,
}

impl<'t> Words<'t> {
    /// `None` where the text does not begin with a number.
    pub(crate) fn split(text: &'t str) -> Option<Self> {
        let text = text.trim();
        let end = number_end(text.as_bytes())?;
        let rest = text[end..].trim_start();
        let (unit, last) = rest.rsplit_once(char::is_whitespace).unwrap_or(("", rest));
        let (unit, sense) = match last {
            "cw" => (unit.trim_end(), Some(Sense::Cw)),
            "ccw" => (unit.trim_end(), Some(Sense::Ccw)),
            _ => (rest, None),
        };
        Some(Self { digits: &text[..end], unit, sense })
    }
}

/// Where the number at the beginning of a text ends.
fn number_end(text: &[u8]) -> Option<usize> {
    let digits = |from: usize| text[from..].iter().take_while(|b| b.is_ascii_digit()).count();
    let sign = usize::from(matches!(text.first(), Some(b'+' | b'-')));
    let whole = digits(sign);
    let mut end = sign + whole;
    let mut any = whole;
    if text.get(end) == Some(&b'.') {
        any += digits(end + 1);
        end += 1 + digits(end + 1);
    }
    if any == 0 {
        return None;
    }
    if matches!(text.get(end), Some(b'e' | b'E')) {
        let sign = usize::from(matches!(text.get(end + 1), Some(b'+' | b'-')));
        let power = digits((end + 1 + sign).min(text.len()));
        if power > 0 {
            end += 1 + sign + power;
        }
    }
    Some(end)
}

/// A positive quotient of paper and world: `1:10`, or `50 cm/s per cm`. In SI units per metre of paper.
pub(crate) fn drawing_scale(value: &Value<'_>, measure: Measure, scales: &Scales) -> Res<f64> {
    let example = match measure {
        Measure::Length => "write it as \"1:10\" or \"10 cm per cm\"".to_owned(),
        _ => format!("write it as \"50 {} per cm\"", measure.example()),
    };
    let text = value.text("a scale, as text").map_err(|fault| fault.mend(example.clone()))?;
    let wrong = || Fault::new(value.at, format!("`{text}` is not a scale")).mend(example.clone());
    let part = |text: &str, measure: Measure, bare: &Scale| -> Res<f64> {
        let words = Words::split(text).filter(|w| w.sense.is_none()).ok_or_else(wrong)?;
        let scale = match words.unit {
            "" => bare.clone(),
            unit => Scale::parse(unit, value.at)?.must_be(measure, value.at)?,
        };
        Ok(scale.apply(number(words.digits, value.at)?).value)
    };
    let plain = |text: &str| match Words::split(text) {
        Some(Words { digits, unit: "", sense: None }) => Ok(number(digits, value.at)?.value),
        _ => Err(wrong()),
    };
    let (world, paper) = if let Some((world, paper)) = text.split_once(" per ") {
        let paper = paper.trim();
        // `per cm` means per 1 cm.
        let paper = match Words::split(paper) {
            Some(words) if !words.unit.is_empty() => part(paper, Measure::Length, scales.bare(measure))?,
            Some(_) => return Err(wrong()),
            None => Scale::parse(paper, value.at)?.must_be(Measure::Length, value.at)?.si(),
        };
        (part(world, measure, scales.bare(measure))?, paper)
    } else if measure == Measure::Length {
        let (paper, world) = text.split_once([':', '/']).ok_or_else(wrong)?;
        (plain(world)?, plain(paper)?)
    } else {
        return Err(wrong());
    };
    let scale = world / paper;
    if world > 0.0 && paper > 0.0 && (SMALLEST..=LARGEST).contains(&scale) {
        return Ok(scale);
    }
    Err(Fault::new(value.at, format!("the scale `{text}` must be greater than zero")).mend(example))
}
/// What people write for a sense or a unit in other places.
fn as_elsewhere(name: &str, whole: &str) -> Option<&'static str> {
    let name = name.to_lowercase();
    match name.rsplit(' ').next().unwrap_or(&name) {
        "counterclockwise" | "anticlockwise" | "ccw" | "acw" => Some("ccw"),
        "clockwise" | "cw" => Some("cw"),
        "°" => Some("deg"),
        "u" | "rot" | "turns" if whole.contains("min") => Some("rpm"),
        _ => None,
    }
}
