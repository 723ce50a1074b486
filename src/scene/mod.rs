//! The scene file: types, units, schema, and diagnostics with line, column, path and mend.
//!
//! **Architecture Invariant:** nothing here solves or draws; the scene is lowered to a
//! [`Mechanism`] in SI units and this room is left.

use crate::mechanism::Mechanism;
use crate::mechanism::quantity::Unit;

/// A scene: the mechanism in SI units and what the file says about asking, publishing and drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Title by language; empty where the file has none.
    pub title: Title,
    /// The units of bare numbers, in which answers are given.
    pub units: Units,
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What somebody printed, in the order of the file.
    pub published: Vec<Published>,
    /// Names in `published` that are known to be wrong.
    pub errata: Vec<String>,
    /// The refusal that this scene must get.
    pub expect: Option<Refusal>,
    /// How to draw.
    pub sheet: SheetOptions,
}

/// A title, in one or more languages.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Title {
    /// Text without a language.
    pub plain: Option<String>,
    /// Language tag and text, in the order of the file.
    pub by_language: Vec<(String, String)>,
}

/// Units of bare numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Unit of length.
    pub length: Unit,
    /// Unit of angles.
    pub angle: Unit,
    /// Unit of time.
    pub time: Unit,
}

/// A published value of an asked (or askable) quantity. Vectors, and scalars without a sense, are
/// compared in magnitude.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// What it is about; its unit is the one in which it was printed.
    pub asked: crate::mechanism::quantity::Asked,
    /// The printed number in SI units.
    pub value: f64,
    /// Whether the print states a sense (cw, ccw, or a sign), so that the sign must agree.
    pub signed: bool,
    /// Allowed relative deviation (0.1 = 10 %), if the scene states one.
    pub within: Option<f64>,
    /// Why that deviation is allowed.
    pub why: Option<String>,
}

/// A refusal that a scene may expect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The chain does not close.
    CannotAssemble,
    /// The position determines nothing that was asked.
    Indeterminate,
    /// Two assemblies and nothing to choose by.
    Ambiguous,
}

/// How to draw the sheet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetOptions {
    /// Paper size (`A4`), default A4.
    pub paper: Option<String>,
    /// Language tag.
    pub language: Option<String>,
    /// Letter for angular acceleration.
    pub angular_acceleration: Option<AngularAcceleration>,
    /// Real length per length of paper: 10 for `1:10`.
    pub length_scale: Option<f64>,
    /// m/s per mm of paper.
    pub velocity_scale: Option<f64>,
    /// m/s² per mm of paper.
    pub acceleration_scale: Option<f64>,
    /// Figures wanted, by name; all where empty.
    pub figures: Vec<String>,
}

/// Which letter stands for angular acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AngularAcceleration {
    /// α.
    Alpha,
    /// ε.
    Epsilon,
}
