//! Constructions on the skeleton besides the polygons and the circle diagram: Klein's, the inflection circle,
//! Kennedy's theorem, the centre of a finite rotation, two masses in the place of a link; and Zhukovsky's lever on the
//! velocity polygon.
//!
//! Each is drawn on the board like everything else, and told as an [`AuxiliaryDrawing`]: strokes, named points and
//! the acts in their order.

mod inflection;
mod kennedy;
mod klein;
mod lever;
mod proportion;
mod rotation;
mod two_masses;

use crate::board::{Location, Point};
use crate::mechanism::engine::Engine;
use crate::mechanism::force::{Action, Force};
use crate::mechanism::quantity::Order;
use crate::mechanism::{LinkId, PointId};
use crate::plan::{Auxiliary, Plan};

use super::centrodes::{self, BranchEnd, Fineness};
use super::construction::{Calculation, Claim, Label, Mm2};
use super::draughtsman::Draughtsman;
pub use klein::rod_foot;
pub(super) use klein::{Klein, KleinAnswer};
pub(super) use lever::ByLever;
pub(super) use two_masses::ByTwoMasses;

/// A construction on the skeleton, coordinates in its frame; the lever has the velocity polygon's.
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

impl AuxiliaryDrawing {
    /// Whether it stands on the velocity polygon and not on the skeleton.
    #[must_use]
    pub const fn is_lever(&self) -> bool {
        matches!(self.kind, Auxiliary::Lever { .. })
    }
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
    /// A curve as straight pieces.
    Curve {
        /// Its points.
        points: Vec<Mm2>,
        /// Where it begins and ends: the direction of the asymptote, outward, where it goes to infinity.
        ends: [Option<[f64; 2]>; 2],
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
    /// A line of an image, measured from end to end.
    Image,
    /// A line of reference, such as a pole tangent: chain, running on beyond both its ends.
    Axis,
    /// What was sought.
    Result,
    /// Its counterpart in the other link: dashed.
    Counterpart,
    /// A vector whose length has no meaning.
    Vector,
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
    /// (13): an instant centre.
    Centre([LinkId; 2]),
    /// J with the name of the point on whose pole ray it lies.
    Inflection(PointId),
    /// W.
    InflectionPole,
    /// G.
    AccelerationCentre,
    /// A′: a point in another position of its link.
    Moved(PointId),
    /// R.
    RotationCentre,
    /// Q: a place on trial.
    Trial,
    /// The velocity of the place on trial as a point of a link.
    TrialVelocity(LinkId),
    /// A curve by the link in which it is fixed.
    CentrodeIn(LinkId),
    /// C: where the second of two masses stands.
    SecondMass,
    /// c′: its image.
    ImageOfSecond,
    /// O: where the lines of two masses meet.
    MeetOfMasses,
    /// The inertia of a mass at a point, or at C.
    InertiaOfMass(Option<PointId>),
    /// The inertia force of a link.
    InertiaForce(LinkId),
    /// Its distance from the mass centre.
    OffsetOfInertia(LinkId),
    /// A force on the lever.
    LeverForce(Action),
    /// The effort at an input, on the lever.
    LeverEffort(usize),
    /// The arm of a force on the lever, by its number.
    LeverArm(usize),
}

/// An act of the draughtsman in an auxiliary construction. Values are SI, lengths of paper mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum AuxiliaryAct {
    /// The crank is taken as its own image, turned back by 90°: ω times the scale of lengths is that of velocities,
    /// ω² times that of accelerations.
    CrankAsImage {
        /// The slider-crank.
        crank: Engine,
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
        crank: Engine,
        /// Angle at which the lines cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// The normal part of the rod as the third proportional of the rod and its velocity image.
    NormalOnRod {
        /// The slider-crank.
        crank: Engine,
        /// How it is drawn.
        proportion: Proportion,
    },
    /// A crank that gathers speed: the tangential part of its pin, and the normal part of the rod moved along.
    TangentialOnCrank {
        /// The slider-crank.
        crank: Engine,
        /// What is laid off, ε/ω² times the crank, mm.
        mm: f64,
    },
    /// The tangential part meets the line through the pole along the guide.
    AlongGuide {
        /// The slider-crank.
        crank: Engine,
        /// Angle at which the lines cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// How directions are read off an image that is turned.
    ReadTurned {
        /// The slider-crank.
        crank: Engine,
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
    /// The pole of a link: where the path normals of two of its points meet.
    PoleByNormals {
        /// The link.
        link: LinkId,
        /// The points.
        points: [PointId; 2],
        /// Angle at which the normals cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// The inflection point on the pole ray of a point, and the line square to the ray there.
    InflectionPoint {
        /// The link.
        link: LinkId,
        /// The point.
        point: PointId,
        /// How.
        by: InflectionBy,
    },
    /// The two lines meet in the inflection pole; the circle on pole and inflection pole.
    InflectionCircle {
        /// The link.
        link: LinkId,
        /// The points by which it was found.
        points: [PointId; 2],
        /// Its diameter, mm.
        mm: f64,
        /// Its diameter, m.
        diameter: f64,
    },
    /// The point of the link that has no acceleration.
    AccelerationCentre {
        /// The link.
        link: LinkId,
        /// ω, rad/s, signed.
        omega: f64,
        /// ε, rad/s², signed.
        alpha: f64,
        /// The angle from the pole normal, radians, ccw.
        angle: f64,
    },
    /// Suppose that the third centre lies off the line of the two others.
    TrialCentre {
        /// The three links; the first is common to the two known centres.
        links: [LinkId; 3],
    },
    /// As a point of either link it would move square to another radius.
    TrialVelocities {
        /// The three links.
        links: [LinkId; 3],
    },
    /// One velocity is only possible where both radii lie in one line.
    OneLine {
        /// The three links.
        links: [LinkId; 3],
    },
    /// Another position of the mechanism.
    OtherPosition {
        /// The link whose rotation is sought.
        link: LinkId,
        /// Where the input stands then: radians, or metres of a slide.
        to: f64,
    },
    /// The perpendicular bisectors of the ways of two points.
    Bisectors {
        /// The link.
        link: LinkId,
        /// The points.
        points: [PointId; 2],
        /// Angle at which they cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// The angle of the rotation, measured at its centre.
    Rotation {
        /// The link.
        link: LinkId,
        /// The point on whose radii it is measured.
        point: PointId,
        /// The angle, radians, ccw.
        angle: f64,
    },
    /// The second mass, from the moment of inertia.
    SecondMass {
        /// The link.
        link: LinkId,
        /// Where the first mass stands.
        first: PointId,
        /// Mass of the link, kg.
        mass: f64,
        /// Its moment of inertia about the mass centre, kg m².
        inertia: f64,
        /// Distances of the masses from the mass centre, m.
        arms: [f64; 2],
    },
    /// Both masses at pins.
    MassesAtPins {
        /// The link.
        link: LinkId,
        /// The pins.
        pins: [PointId; 2],
        /// Distances of the pins from the mass centre, m.
        arms: [f64; 2],
    },
    /// The image of the second mass.
    ImageOfSecond {
        /// The link.
        link: LinkId,
        /// Where the first mass stands.
        first: PointId,
    },
    /// The lines of the two masses meet.
    LinesOfMasses {
        /// The link.
        link: LinkId,
        /// Where the first mass stands.
        first: PointId,
        /// Where the second one stands, if that is a point of the link.
        second: Option<PointId>,
        /// Angle at which they cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// One mass has no acceleration; a point, or none for the second one off the points of the link.
    OneMassRests {
        /// The link.
        link: LinkId,
        /// Which one.
        rests: Option<PointId>,
        /// The other one.
        acts: Option<PointId>,
    },
    /// The lines of the two masses do not meet on the paper: the force is laid off at its distance.
    LinesApart {
        /// The link.
        link: LinkId,
    },
    /// The couple by which two masses at pins turn the link more or less than its own inertia does.
    CorrectingCouple {
        /// The link.
        link: LinkId,
        /// The pins.
        pins: [PointId; 2],
        /// Mass of the link, kg.
        mass: f64,
        /// Its moment of inertia about the mass centre, kg m².
        inertia: f64,
        /// Distances of the pins from the mass centre, m.
        arms: [f64; 2],
        /// ε, rad/s², signed.
        alpha: f64,
        /// The couple, N m, ccw positive.
        couple: f64,
    },
    /// The inertia force in its line.
    LineOfInertia {
        /// The link.
        link: LinkId,
        /// Mass of the link, kg.
        mass: f64,
        /// Its size, N.
        size: f64,
        /// Its distance from the mass centre, m.
        arm: f64,
    },
    /// The velocity polygon is turned.
    TurnedPolygon,
    /// A force on the image of its point.
    MomentOnLever {
        /// The force.
        action: Action,
        /// The number of its arm.
        number: usize,
        /// Its size, N.
        size: f64,
        /// Its arm, mm.
        mm: f64,
        /// m/s per millimetre.
        si_per_mm: f64,
        /// Its moment, W, ccw positive.
        moment: f64,
    },
    /// The line of a force passes through the pole.
    NoArmOnLever {
        /// The force.
        action: Action,
    },
    /// A couple on the image of its link.
    CoupleOnLever {
        /// The couple.
        of: Force,
        /// The link.
        link: LinkId,
        /// N m, ccw positive.
        torque: f64,
        /// ω of the link, rad/s, signed.
        omega: f64,
    },
    /// The effort that balances the lever.
    EffortOfLever {
        /// The effort.
        of: Force,
        /// Sum of the moments of everything else, W.
        moments: f64,
        /// ω of the driven link, rad/s, or the velocity along the guide, m/s, signed.
        speed: f64,
        /// The effort, N m or N.
        effort: f64,
    },
    /// The loci of an instant centre in both its links.
    Loci {
        /// The links: the first carries the fixed centrode.
        links: [LinkId; 2],
        /// The curves lie within this of the loci, mm.
        within: f64,
    },
}

/// How a third proportional is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Proportion {
    /// By the common chord of two circles.
    Chord,
    /// By a tangent, where the circles do not meet.
    Tangent,
}

/// How the inflection point on the pole ray of a point is found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InflectionBy {
    /// The point turns about a fixed pivot, the centre of curvature of its path.
    Pivot {
        /// The pivot.
        pivot: PointId,
        /// How the third proportional is drawn.
        proportion: Proportion,
    },
    /// The point runs on an arc guide of the frame.
    Arc {
        /// Index of the sliding pair.
        slide: usize,
        /// How the third proportional is drawn.
        proportion: Proportion,
    },
    /// The point runs on a straight guide of the frame: it is its own inflection point.
    Straight {
        /// Index of the sliding pair.
        slide: usize,
    },
    /// From the acceleration polygon: the normal part over ω² is laid off toward the pole.
    Acceleration {
        /// Aⁿ toward the pole, m/s², signed.
        normal: f64,
        /// What is laid off, mm, signed.
        mm: f64,
    },
}

/// The curves of centrodes lie within this of the loci, mm of paper: less than a hair line.
const CURVE_WITHIN: f64 = 0.02;
/// Centrodes are followed so far from the skeleton's first fixed point, mm of paper: well off any sheet.
const CURVE_REACH: f64 = 600.0;

/// Draws the planned auxiliary constructions.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) {
    draw_all(d, &plan.auxiliary);
}

/// Draws those among them that lead to forces: whoever reads forces off a board reads them there.
pub(super) fn draw_for_forces(d: &mut Draughtsman<'_>, plan: &Plan) {
    let leads = |kind: &&Auxiliary| matches!(kind, Auxiliary::TwoMasses { .. } | Auxiliary::Lever { .. });
    let wanted: Vec<Auxiliary> = plan.auxiliary.iter().filter(leads).copied().collect();
    draw_all(d, &wanted);
}

fn draw_all(d: &mut Draughtsman<'_>, wanted: &[Auxiliary]) {
    for &auxiliary in wanted {
        d.open_auxiliary(auxiliary);
        match auxiliary {
            Auxiliary::Klein { crank, order } => d.draw_klein(crank, order),
            Auxiliary::Inflection { link } => d.draw_inflection(link),
            Auxiliary::Kennedy { links } => d.draw_kennedy(links),
            Auxiliary::Rotation { link, to } => d.draw_rotation(link, to),
            Auxiliary::Centrodes { links } => d.draw_centrodes(links),
            Auxiliary::TwoMasses { link, first, second } => d.draw_two_masses(link, (first, second)),
            Auxiliary::Lever { input } => d.draw_lever(input),
        }
    }
}

impl Draughtsman<'_> {
    /// Draws the centrodes of two links. They are curves through many positions, each drawn on its own board.
    fn draw_centrodes(&mut self, links: [LinkId; 2]) {
        let per_mm = self.scales.length();
        let page = self.per_page * per_mm;
        let fineness = Fineness { tolerance: CURVE_WITHIN * page, reach: CURVE_REACH * page };
        let found = match centrodes::trace(self.mechanism, self.structure, links, fineness) {
            Ok(found) => found,
            Err(why) => return self.refuse_auxiliary(centrodes::clause(&why)),
        };
        let pair = crate::plan::chord(links[0], links[1]);
        let mut present = None;
        if let Some(&centre) = self.centres.known.get(&pair) {
            let reason = self.reason(&links);
            if let Location::At(at) = self.board.locate(centre, reason) {
                self.aux_point(PointName::Centre(pair), at);
                present = Some(at.value());
            }
        }
        let curves = [(found.fixed, StrokeRole::Result), (found.moving, StrokeRole::Counterpart)];
        for ((branches, role), link) in curves.into_iter().zip(links) {
            for branch in &branches {
                let points: Vec<Mm2> = branch.points.iter().map(|p| p.map(|x| x / per_mm)).collect();
                let ends = branch.ends.map(|end| match end {
                    BranchEnd::Infinity(direction) => Some(direction),
                    BranchEnd::Closed | BranchEnd::Limit | BranchEnd::Reach | BranchEnd::Gap => None,
                });
                self.note_stroke(Stroke { shape: StrokeShape::Curve { points, ends }, role, claim: None });
            }
            // The curve is named at one of its points near the skeleton.
            let near = branches.iter().flat_map(|b| b.points.iter()).map(|p| p.map(|x| x / per_mm));
            let near =
                near.min_by(|a, b| self.name_cost(*a, present).total_cmp(&self.name_cost(*b, present)));
            if let Some(at) = near {
                self.note_named(NamedPoint { name: PointName::CentrodeIn(link), at });
            }
        }
        self.act_auxiliary(AuxiliaryAct::Loci { links, within: CURVE_WITHIN * self.per_page });
    }

    /// How badly a curve is named at a place: far from the skeleton, or close to the present centre.
    fn name_cost(&self, at: Mm2, present: Option<Mm2>) -> f64 {
        let places: Vec<Mm2> = self.places.iter().flatten().map(Point::value).collect();
        let count = places.len().max(1) as f64;
        let middle = [0, 1].map(|k| places.iter().map(|p| p[k]).sum::<f64>() / count);
        // About a hand's breadth from the middle: clear of the links, and on the sheet.
        let off = (libm::hypot(at[0] - middle[0], at[1] - middle[1]) - 45.0 * self.per_page).abs();
        // Where they touch, the two curves run beside each other.
        let apart = present.map_or(f64::INFINITY, |p| libm::hypot(at[0] - p[0], at[1] - p[1]));
        off + 3.0 * (40.0 * self.per_page - apart).max(0.0)
    }

    /// Whether a point is determined: no divisor behind it is weak.
    pub(super) fn stands(&mut self, point: Point) -> bool {
        let origin = self.board.origin();
        let marks = self.board.between(origin, point).map(|mm| mm.mark());
        marks.into_iter().all(|mark| self.board.tape().weakness(mark).is_none())
    }
}

impl Draughtsman<'_> {
    pub(super) fn aux_line(&mut self, from: Point, to: Point, role: StrokeRole, claim: Option<Claim>) {
        self.note_stroke(Stroke { shape: StrokeShape::Line(from.value(), to.value()), role, claim });
    }

    pub(super) fn aux_circle(&mut self, centre: Point, radius: f64, role: StrokeRole) {
        let shape = StrokeShape::Circle { centre: centre.value(), radius };
        self.note_stroke(Stroke { shape, role, claim: None });
    }

    /// A mark that two lines from a corner are square to each other.
    pub(super) fn aux_square(&mut self, corner: Point, one: Point, other: Point) {
        let shape =
            StrokeShape::RightAngle { corner: corner.value(), one: one.value(), other: other.value() };
        self.note_stroke(Stroke { shape, role: StrokeRole::Construction, claim: None });
    }

    pub(super) fn aux_point(&mut self, name: PointName, at: Point) {
        self.note_named(NamedPoint { name, at: at.value() });
    }
}
