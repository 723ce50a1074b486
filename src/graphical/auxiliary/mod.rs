//! Constructions on the skeleton besides the polygons and the circle diagram: Klein's, the inflection circle,
//! Kennedy's theorem, the centre of a finite rotation.
//!
//! Each is drawn on the board like everything else, and told as an [`AuxiliaryDrawing`]: strokes, named points and
//! the acts in their order.

mod klein;

use crate::board::{Bench, Point};
use crate::mechanism::quantity::Order;
use crate::mechanism::slider_crank::SliderCrank;
use crate::mechanism::{LinkId, PointId};
use crate::plan::{Auxiliary, Plan};

use super::construction::{Calculation, Claim, Label, Mm2};
use super::draughtsman::Draughtsman;
pub(super) use klein::{Klein, KleinAnswer};

/// A construction on the skeleton, coordinates in its frame.
#[derive(Debug, Clone, PartialEq)]
pub struct AuxiliaryDrawing {
    /// Which it is.
    pub kind: Auxiliary,
    /// The strokes, in the order of drawing.
    pub strokes: Vec<Stroke>,
    /// The points that have a name here.
    pub points: Vec<NamedPoint>,
    /// What the draughtsman does, in order.
    pub acts: Vec<AuxiliaryAct>,
    /// Why it stopped, where the construction does not exist here; in plain English, one clause.
    pub refused: Option<&'static str>,
}

/// A stroke of an auxiliary construction.
#[derive(Debug, Clone, PartialEq)]
pub struct Stroke {
    /// Its geometry.
    pub shape: StrokeShape,
    /// What it is.
    pub role: StrokeRole,
    /// The direction it claims to have.
    pub claim: Option<Claim>,
}

/// Geometry of a stroke.
#[derive(Debug, Clone, PartialEq)]
pub enum StrokeShape {
    /// From point to point.
    Line(Mm2, Mm2),
    /// A whole circle.
    Circle {
        /// Where the compass stands.
        centre: Mm2,
        /// Its opening.
        radius: f64,
    },
    /// A small square in a corner: the directions are square to each other.
    RightAngle {
        /// The corner.
        corner: Mm2,
        /// A point along one leg.
        one: Mm2,
        /// A point along the other.
        other: Mm2,
    },
}

/// What a stroke of an auxiliary construction is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StrokeRole {
    /// A line of the construction: thin.
    Construction,
    /// A line that runs on beyond both its ends.
    Produced,
    /// A vector of an image: an arrow from its start to its end.
    Vector,
    /// What was sought: thick.
    Result,
    /// Another position of a link: dashed.
    Other,
}

/// A point of an auxiliary construction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NamedPoint {
    /// Its name.
    pub name: PointName,
    /// Its place.
    pub at: Mm2,
}

/// The name of a point of an auxiliary construction.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PointName {
    /// b, b′: an image point of a polygon drawn on the skeleton.
    Image(Label, Order),
}

/// An act of the draughtsman in an auxiliary construction. Values are SI, lengths of paper mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AuxiliaryAct {
    /// The crank is taken as its own image, turned back by 90°: ω times the scale of lengths is that of velocities,
    /// ω² times that of accelerations.
    CrankAsImage {
        /// The slider-crank.
        crank: SliderCrank,
        /// ω of the crank, signed.
        omega: f64,
        /// m/s per millimetre.
        velocity: f64,
        /// m/s² per millimetre, where accelerations are sought.
        acceleration: Option<f64>,
    },
    /// Square to the guide through the pole to the rod's line.
    AcrossGuide {
        /// The slider-crank.
        crank: SliderCrank,
        /// Angle at which the lines cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// The common chord of the circle on the rod and the circle about the crank pin gives the normal part.
    ChordOnRod {
        /// The slider-crank.
        crank: SliderCrank,
    },
    /// Where the image is longer than the rod the circles do not meet: the tangent of the second does the same.
    TangentOnRod {
        /// The slider-crank.
        crank: SliderCrank,
    },
    /// A crank that gathers speed: the tangential part of its pin, and the normal part of the rod moved along.
    TangentialOnCrank {
        /// The slider-crank.
        crank: SliderCrank,
        /// What is laid off, ε/ω² times the crank, mm.
        mm: f64,
    },
    /// The tangential part meets the line through the pole along the guide.
    AlongGuide {
        /// The slider-crank.
        crank: SliderCrank,
        /// Angle at which the lines cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// How directions are read off an image that is turned.
    ReadTurned {
        /// The slider-crank.
        crank: SliderCrank,
        /// Accelerations are read as well.
        accelerations: bool,
    },
    /// Read a vector of the turned image.
    ReadImage {
        /// What it stands for.
        quantity: crate::mechanism::quantity::Quantity,
        /// Start of its line.
        tail: Label,
        /// End of its line.
        head: Label,
        /// Its length, mm.
        mm: f64,
        /// SI units per millimetre.
        si_per_mm: f64,
    },
    /// A calculation of the textbook.
    Calculate(Calculation),
}

/// Draws the planned auxiliary constructions.
pub(super) fn draw<B: Bench>(d: &mut Draughtsman<'_, B>, plan: &Plan) {
    for &auxiliary in &plan.auxiliary {
        d.open_auxiliary(auxiliary);
        match auxiliary {
            Auxiliary::Klein { crank, order } => d.draw_klein(crank, order),
        }
    }
}

impl<B: Bench> Draughtsman<'_, B> {
    pub(super) fn aux_line(&mut self, from: Point<B>, to: Point<B>, role: StrokeRole, claim: Option<Claim>) {
        self.note_stroke(Stroke { shape: StrokeShape::Line(from.value(), to.value()), role, claim });
    }

    pub(super) fn aux_circle(&mut self, centre: Point<B>, radius: f64, role: StrokeRole) {
        let shape = StrokeShape::Circle { centre: centre.value(), radius };
        self.note_stroke(Stroke { shape, role, claim: None });
    }

    /// A mark that two lines from a corner are square to each other.
    pub(super) fn aux_square(&mut self, corner: Point<B>, one: Point<B>, other: Point<B>) {
        let shape =
            StrokeShape::RightAngle { corner: corner.value(), one: one.value(), other: other.value() };
        self.note_stroke(Stroke { shape, role: StrokeRole::Construction, claim: None });
    }

    pub(super) fn aux_point(&mut self, name: PointName, at: Point<B>) {
        self.note_named(NamedPoint { name, at: at.value() });
    }
}

/// The places of the skeleton's points that a construction refers to.
#[must_use]
pub fn links_and_points(kind: &Auxiliary) -> (Vec<LinkId>, Vec<PointId>) {
    match kind {
        Auxiliary::Klein { crank, .. } => {
            (vec![crank.crank, crank.rod], vec![crank.pivot, crank.crank_pin, crank.slider_pin])
        }
    }
}
