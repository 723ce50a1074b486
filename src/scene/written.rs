//! Numbers as their author wrote them: the sheet prints a given number in its own unit, not in one that it was counted in.

use super::json::{Kind, Value};
use super::units::{Dimension, Measure, Scale, Scales, Words};
use crate::mechanism::quantity::Unit;

/// The units in which numbers of the file are written, where they are not the scene's, and its angles.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Written {
    /// Dimension, size in SI units, unit.
    sizes: Vec<(Dimension, f64, Unit)>,
    /// Radians with all turns; whether they are written in radians.
    angles: Vec<(f64, bool)>,
}

/// Keys of the file under which an angle stands.
const ANGLES: [&str; 3] = ["angle", "direction", "turned"];

impl Written {
    /// Reads a scene.
    pub(super) fn read(root: &Value<'_>, scales: &Scales) -> Self {
        let mut all = Self::default();
        all.walk(root, scales);
        all
    }

    fn walk(&mut self, value: &Value<'_>, scales: &Scales) {
        match &value.kind {
            Kind::List(items) => items.iter().for_each(|item| self.walk(item, scales)),
            Kind::Object(entries) => {
                for entry in entries {
                    if ANGLES.contains(&&*entry.key) {
                        self.angle(&entry.value, scales);
                    }
                    self.walk(&entry.value, scales);
                }
            }
            Kind::Text(text) => self.size(text),
            Kind::Null | Kind::Bool(_) | Kind::Number(_) => {}
        }
    }

    fn size(&mut self, text: &str) {
        let Some(words) = Words::split(text).filter(|words| !words.unit.is_empty()) else { return };
        let (Ok(scale), Ok(read)) = (Scale::parse(words.unit, 0), super::units::number(words.digits, 0))
        else {
            return;
        };
        let unit = scale.unit();
        self.sizes.push((scale.dimension(), (read.value * unit.si).abs(), unit));
    }

    fn angle(&mut self, value: &Value<'_>, scales: &Scales) {
        let stated = scales.stated(value, Measure::Angle, true, scales.bare(Measure::Angle));
        let (Ok(stated), Ok(whole)) = (stated, super::inputs::unreduced(value, scales)) else { return };
        self.angles.push((whole, stated.scale.unit().symbol == "rad"));
    }

    /// The unit in which a size is written; else the usual one.
    #[must_use]
    pub fn unit_of(&self, si: f64, usual: &Unit) -> Unit {
        /// As a number is rounded when it is counted in another unit.
        const ROUNDED: f64 = 1e-12;
        let Ok(dimension) = Scale::parse(&usual.symbol, 0).map(|scale| scale.dimension()) else {
            return usual.clone();
        };
        let same = |(of, size, _): &&(Dimension, f64, Unit)| {
            *of == dimension && (size - si.abs()).abs() <= ROUNDED * size
        };
        self.sizes.iter().find(same).map_or_else(|| usual.clone(), |(.., unit)| unit.clone())
    }

    /// An angle as it is written, and whether in radians; none that is written nowhere, or only with more than a turn.
    #[must_use]
    pub fn angle_of(&self, si: f64) -> Option<(f64, bool)> {
        self.angle_within(si, std::f64::consts::TAU)
    }

    /// The same with all its turns.
    #[must_use]
    pub fn angle_with_turns(&self, si: f64) -> Option<(f64, bool)> {
        self.angle_within(si, f64::INFINITY)
    }

    fn angle_within(&self, si: f64, most: f64) -> Option<(f64, bool)> {
        /// As an angle is rounded when its turns are taken off.
        const ROUNDED: f64 = 1e-12;
        let turn = std::f64::consts::TAU;
        let rounded = |own: f64| ROUNDED * own.abs().max(1.0);
        let same = |(own, _): &&(f64, bool)| {
            own.abs() <= most && libm::remainder(own - si, turn).abs() <= rounded(*own)
        };
        // Its own writing before one that is a turn away.
        let exact = |(own, _): &&(f64, bool)| (own - si).abs() <= rounded(*own);
        self.angles.iter().find(exact).or_else(|| self.angles.iter().find(same)).copied()
    }
}
