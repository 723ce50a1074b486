//! What stands on the paper when the construction is finished, and in which order it came there.
//!
//! A [`Construction`] is all that `sheet/` needs: images, vectors, construction lines and the acts of
//! the draughtsman in their order. Coordinates are paper millimetres in each diagram's own frame: the
//! pole of a polygon, the first fixed point of the skeleton, is (0, 0).

use std::fmt;

use crate::double_double::DoubleDouble;
use crate::mechanism::force::{Action, Force, Party, Share, Sought};
use crate::mechanism::friction::Rub;
use crate::mechanism::quantity::{Answer, DiagramKind, Method, Nature, Order, Quantity};
use crate::mechanism::structure::{Closing, TrialDriver};
use crate::mechanism::{Direction, GuidePoint, LinkId, Mechanism, Path, PointId};

use super::auxiliary::AuxiliaryDrawing;
pub use super::centres::CentreLine;
use super::cycle::CycleSheet;

/// A place on the paper, millimetres in the diagram's own frame.
pub type Mm2 = [f64; 2];

/// The whole graphical solution.
#[derive(Debug, Clone)]
pub struct Construction {
    /// The kinematic skeleton.
    pub space: Space,
    /// The vector diagrams that the asked quantities need, in the order in which they were begun: one of a kind.
    pub diagrams: Vec<Diagram>,
    /// The circle diagram, if any instant centre is wanted.
    pub circle: Option<CircleDiagram>,
    /// The balance of forces, if any asked quantity needs it.
    pub forces: Option<ForceSheet>,
    /// The turning-moment diagram, if anything of it is asked.
    pub cycle: Option<CycleSheet>,
    /// The other constructions on the skeleton, in the order of the plan.
    pub auxiliary: Vec<AuxiliaryDrawing>,
    /// Other positions of the mechanism that the skeleton shows, in the order in which they were wished.
    pub others: Vec<OtherPosition>,
    /// The numbered steps, in the order in which they were drawn.
    pub steps: Vec<Step>,
    /// Whether places are known within rooms only, stated ones or those that their digits leave.
    pub rooms: bool,
    /// One answer per asked quantity, in order.
    pub answers: Vec<Reading>,
}

impl Construction {
    /// The fixed points that are nothing but centres of arcs of the frame and lie so far off that the skeleton would be half as
    /// large again with them: the paper has the arc, and an arrow towards its centre. None where a stated place, a force or a
    /// construction on the skeleton may start from there.
    #[must_use]
    pub fn far_centres(&self, mechanism: &Mechanism) -> Vec<PointId> {
        /// By so much may a centre widen or heighten the skeleton.
        const LARGER: f64 = 1.5;
        let starts_elsewhere = self.circle.is_some() || self.forces.is_some() || !self.auxiliary.is_empty();
        if starts_elsewhere || !mechanism.statements.is_empty() {
            return Vec::new();
        }
        let centre = |path: Path| match path {
            Path::Arc { centre: GuidePoint::Point(point), .. } => Some(point),
            _ => None,
        };
        let begins = |path: Path| match path {
            Path::Straight { through, direction, .. } => {
                let through = if let GuidePoint::Point(point) = through { Some(point) } else { None };
                let toward = if let Direction::Toward(point) = direction { Some(point) } else { None };
                [through, toward]
            }
            Path::Arc { .. } => [None, None],
        };
        let paths = || mechanism.slides.iter().map(|slide| (slide.guide.link, slide.guide.path));
        let lone = |point: PointId| {
            paths().any(|(link, path)| link == LinkId::FRAME && centre(path) == Some(point))
                && mechanism.is_fixed(point)
                && mechanism.point(point).links.iter().all(|link| *link == LinkId::FRAME)
                && !paths().any(|(_, path)| begins(path).contains(&Some(point)))
                && !mechanism.asked.iter().any(|asked| asked.quantity.about().0.contains(&Some(point)))
        };
        let (lone, others): (Vec<PointId>, Vec<PointId>) =
            (0..mechanism.points.len()).map(PointId).partition(|point| lone(*point));
        let place = |point: &PointId| self.space.places.get(point.0).copied().flatten();
        let mut own: Option<[Mm2; 2]> = None;
        for at in others.iter().filter_map(place) {
            let [least, most] = own.get_or_insert([at, at]);
            for axis in [0, 1] {
                (least[axis], most[axis]) = (least[axis].min(at[axis]), most[axis].max(at[axis]));
            }
        }
        let Some([least, most]) = own else { return Vec::new() };
        let far = |point: &PointId| {
            let Some(at) = place(point) else { return false };
            [0, 1].into_iter().any(|axis| {
                let with = most[axis].max(at[axis]) - least[axis].min(at[axis]);
                // A flat skeleton is as high as its links need for their names.
                let alone = (most[axis] - least[axis]).max(0.25 * (most[1 - axis] - least[1 - axis]));
                with > LARGER * alone
            })
        };
        lone.into_iter().filter(far).collect()
    }

    /// The longest vector of a polygon, SI units; 0 where there is none.
    #[must_use]
    pub fn longest(&self, order: Order) -> f64 {
        let Some(diagram) = self.diagram(order.diagram()) else { return 0.0 };
        let lengths = diagram.vectors.iter().map(Vector::length);
        lengths.fold(0.0, f64::max) * diagram.si_per_mm
    }

    /// Whether a number of this size is told as zero: its bound allows zero. Where places are known within rooms only, that
    /// shows nothing: there it must be nothing beside its bound, or its bound nothing beside the polygon.
    #[must_use]
    pub fn is_told_as_zero(&self, quantity: &Quantity, answer: &Answer) -> bool {
        let (size, bound) = match answer {
            Answer::Scalar { value, bound } => (value.abs(), *bound),
            Answer::Vector { value: [x, y], bound } => (libm::hypot(*x, *y), *bound),
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return false,
        };
        if !self.rooms || !answer.may_be_zero() {
            return answer.may_be_zero();
        }
        let order = quantity.order();
        let largest = match quantity.nature() {
            _ if !matches!(order, Order::Velocity | Order::Acceleration) => 0.0,
            Nature::Vector => self.longest(order),
            // So fast the skeleton would turn with the longest of them at its end.
            _ => self.longest(order) / self.space.size(),
        };
        size <= NIL * bound || bound <= NIL * largest
    }

    /// The coordinates of a place as they are told: one that is zero within its bound is zero. Where places are known within
    /// rooms only, the bound beside the skeleton has to be nothing as well.
    #[must_use]
    pub fn told_place(&self, place: [f64; 2], bound: f64) -> [f64; 2] {
        let sharp = !self.rooms || bound <= NIL * self.space.size();
        place.map(|own| if own.abs() <= bound && (sharp || own.abs() <= NIL * bound) { 0.0 } else { own })
    }

    /// The vector diagram of a kind, where anything asked needs it.
    #[must_use]
    pub fn diagram(&self, kind: DiagramKind) -> Option<&Diagram> {
        self.diagrams.iter().find(|diagram| diagram.kind == kind)
    }
}

/// What is no more than this part of another number is nothing beside it.
const NIL: f64 = 1e-9;

/// An asked quantity as read off the paper.
#[derive(Debug, Clone, PartialEq)]
pub struct Reading {
    /// The value in SI units with its bound.
    pub answer: Answer,
    /// Whether it is told as zero, without sense, direction and digits.
    pub zero: bool,
    /// The value in the board's own arithmetic, where that is finer than a double.
    pub fine: Option<Fine>,
    /// The length of its vector on the paper, for quantities that are a vector of a polygon.
    pub drawn_mm: Option<f64>,
    /// A point of the line of a force, metres in the world.
    pub through: Option<[f64; 2]>,
    /// The couple that is left where forces have no sum, N·m, ccw positive.
    pub couple: Option<f64>,
}

/// The free bodies and force polygons, in newtons and metres from the skeleton's origin: they are drawn to a scale of their
/// own.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ForceSheet {
    /// Of which part of the forces.
    pub share: Share,
    /// A governor, whose speeds follow from the balance of its sleeve and its arm.
    pub governor: Option<Governor>,
    /// What inertia and weight each mass has.
    pub masses: Vec<MassForces>,
    /// The bodies in the order of solution.
    pub bodies: Vec<FreeBody>,
    /// Moments, each told at one of the bodies.
    pub moments: Vec<MomentBalance>,
    /// Arms and moments that are asked, each about its point, and whether a balance has the same arm (`told` is 1).
    pub arms: Vec<MomentBalance>,
    /// Where three forces on a body meet.
    pub meets: Vec<MeetOfThree>,
    /// Several links on which two forces act together.
    pub members: Vec<Member>,
    /// Everything that acts on the mechanism from outside; empty where not all of it was needed.
    pub whole: Vec<Acting>,
    /// The inertia forces, whose sum shakes the frame; empty where not all were needed.
    pub inertia: Vec<Acting>,
    /// The line of their sum, from the first fixed pivot.
    pub shaking: Option<MomentBalance>,
    /// Somebody asks for that sum, its moment or its arm.
    pub asks_shaking: bool,
    /// What moving links exert on the frame pair by pair, where their sum is asked.
    pub frame: Vec<Acting>,
    /// The line of that sum, from the first fixed pivot.
    pub frame_line: Option<MomentBalance>,
    /// What was sought elsewhere than at the input, by two trials.
    pub trial: Option<Trial>,
    /// What groups of higher class leave open.
    pub group_trials: Vec<GroupTrial>,
    /// The rolling pairs that keep their own contact, by index.
    pub contacts: Vec<usize>,
    /// What was sought elsewhere than at several inputs.
    pub trials: Option<Trials>,
    /// What rubs, and in which sense, each with the force that leans or touches its circle.
    pub rubs: Vec<Touch>,
    /// How often the forces were drawn again because they lean and touch circles.
    pub passes: usize,
    /// The sizes of loads that change with the angle of the first input.
    pub sizes: Vec<LoadSize>,
    /// How torsion springs stand.
    pub twists: Vec<SpringTwist>,
    /// Stiffnesses that were sought.
    pub stiffnesses: Vec<Stiffness>,
}

/// The stiffness of a spring, found from the balance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stiffness {
    /// Which, by its index.
    pub spring: usize,
    /// N/m, or N·m for a radian. No spring has one below zero.
    pub value: f64,
    /// How much longer the spring is than without load, metres; how much further turned, radians.
    pub longer: f64,
}

/// The size of a load as it is read from its curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadSize {
    /// Which, by its index.
    pub load: usize,
    /// The angle of the first input, radians.
    pub angle: f64,
    /// The height of the curve there, SI units.
    pub height: f64,
}

/// How a torsion spring stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpringTwist {
    /// Which, by its index.
    pub spring: usize,
    /// How much further its second link is turned against the first than without load, radians.
    pub further: f64,
}

/// A force with friction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// The pair, and how it moves.
    pub rub: Rub,
    /// On which link the force acts, and of which.
    pub between: [LinkId; 2],
    /// The pin, metres from the skeleton's origin.
    pub at: [f64; 2],
    /// A point of the line of the force.
    pub through: [f64; 2],
    /// Newtons.
    pub force: [f64; 2],
    /// The direction of a guide; none of a pin.
    pub along: Option<[f64; 2]>,
    /// How both links turn, rad/s; none of a guide.
    pub rates: Option<[f64; 2]>,
}

impl Touch {
    /// Whether its force acts on a body.
    #[must_use]
    pub fn acts_on(&self, body: &FreeBody) -> bool {
        self.between.iter().any(|link| body.has(*link))
    }
}

/// The tangent of two friction circles along which the force of a link with two pins runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrictionAxis {
    /// Both circles lie on one side of it.
    Outer,
    /// It runs between them.
    Inner,
}

impl ForceSheet {
    /// The friction axis of a link on which nothing acts but the forces of two pins that rub.
    #[must_use]
    pub fn friction_axis(&self, body: &FreeBody) -> Option<FrictionAxis> {
        let circles: Vec<&Touch> = self
            .rubs
            .iter()
            .filter(|touch| {
                touch.along.is_none()
                    && (body.of == Party::Link(touch.between[0]) || body.of == Party::Link(touch.between[1]))
            })
            .collect();
        let [first, second] = circles[..] else { return None };
        if body.acting.len() != 2 || !body.torques.is_empty() {
            return None;
        }
        // On which side of the one line each pin lies.
        let side = |touch: &Touch| {
            let [fx, fy] = first.force;
            fx * (touch.at[1] - touch.through[1]) - fy * (touch.at[0] - touch.through[0])
        };
        Some(if side(first) * side(second) > 0.0 { FrictionAxis::Outer } else { FrictionAxis::Inner })
    }
}

/// The weight and the inertia of a link, SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MassForces {
    /// The link.
    pub link: LinkId,
    /// Its mass centre.
    pub centre: PointId,
    /// Its mass; none of a flywheel.
    pub mass: Option<f64>,
    /// Its moment of inertia about the mass centre; none of a point mass.
    pub inertia: Option<f64>,
    /// Its weight, where weights act.
    pub weight: Option<f64>,
    /// The acceleration of its mass centre.
    pub acceleration: f64,
    /// Its angular acceleration, ccw positive; none of a link that does not turn.
    pub alpha: Option<f64>,
}

/// A load or spring found by proportion from the efforts that two sizes of it need.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Trial {
    /// What was sought.
    pub sought: Sought,
    /// The size of the second trial, SI; the first is zero.
    pub tried: f64,
    /// The efforts of both, SI.
    pub efforts: [f64; 2],
    /// What it comes to, SI.
    pub size: f64,
}

/// Several loads or springs found in proportion from the efforts that a unit of each needs.
#[derive(Debug, Clone, PartialEq)]
pub struct Trials {
    /// What was sought and what it comes to, SI.
    pub sought: Vec<(Sought, f64)>,
    /// The size of each trial, SI.
    pub tried: f64,
    /// The effort at each input without what is sought, SI.
    pub without: Vec<f64>,
    /// The same with each of what is sought tried alone, in its order.
    pub with: Vec<Vec<f64>>,
}

/// A body cut free: a link, or a pin at which more than two links meet.
#[derive(Debug, Clone, PartialEq)]
pub struct FreeBody {
    /// The link or the pin.
    pub of: Party,
    /// Links that are cut free with it, as if they were one.
    pub with: Vec<LinkId>,
    /// The forces on it: first what is known, as they are laid off.
    pub acting: Vec<Acting>,
    /// Torques on it, ccw positive, N m.
    pub torques: Vec<(Force, f64)>,
    /// It is balanced together with the next one: their polygons follow both.
    pub with_next: bool,
    /// Its polygon gives what the polygons of those that are balanced together with it need: it is laid off first.
    pub gives: bool,
}

impl FreeBody {
    /// The links that are cut free; none of a pin.
    #[must_use]
    pub fn links(&self) -> Vec<LinkId> {
        match self.of {
            Party::Link(link) => std::iter::once(link).chain(self.with.iter().copied()).collect(),
            Party::Pin(_) => Vec::new(),
        }
    }

    /// Whether a link belongs to it.
    #[must_use]
    pub fn has(&self, link: LinkId) -> bool {
        self.of == Party::Link(link) || self.with.contains(&link)
    }

    /// Whether it is one of these links, or all of them as if they were one.
    #[must_use]
    pub fn is_of(&self, links: &[LinkId]) -> bool {
        let own = self.links();
        own.len() == links.len() && own.iter().all(|link| links.contains(link))
    }
}

/// Several links that have two forces together, from without: these are one and the same line, through both ends.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    /// The links.
    pub links: Vec<LinkId>,
    /// The points at which the forces act.
    pub ends: [PointId; 2],
    /// The body at which it is told, by its place in the order of solution.
    pub told: usize,
}

/// Moments of one body, or of some as if they were one, about a point.
#[derive(Debug, Clone, PartialEq)]
pub struct MomentBalance {
    /// The bodies.
    pub links: Vec<LinkId>,
    /// The body at which they are told, by its place in the order of solution.
    pub told: usize,
    /// The point.
    pub about: About,
    /// What is known.
    pub terms: Vec<MomentTerm>,
    /// What they give.
    pub found: MomentTerm,
    /// A body in a guide whose forces are carried to its pin: the couple that this leaves is the guide's,
    /// and turns nothing else.
    pub carried: Option<(LinkId, PointId)>,
}

/// Three forces on a body meet in a point: what is known, a second one, and a third one that passes through a pin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeetOfThree {
    /// The body, by its place in the order of solution.
    pub told: usize,
    /// The link.
    pub link: LinkId,
    /// Metres from the skeleton's origin.
    pub at: [f64; 2],
    /// A point of the line of what is known, metres from the skeleton's origin.
    pub through: [f64; 2],
}

/// About what moments are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum About {
    /// A point of the mechanism.
    Point(PointId),
    /// Where the lines of two forces meet.
    Meet {
        /// The link on which they act.
        on: LinkId,
        /// The forces.
        of: [Action; 2],
        /// Metres from the skeleton's origin.
        at: [f64; 2],
    },
    /// Where the force of a pin that rubs touches its circle.
    Contact {
        /// The pin.
        pin: PointId,
        /// Metres from the skeleton's origin.
        at: [f64; 2],
    },
    /// The instantaneous centre of a link that is led by the frame and hangs on a slide: where the line of what the frame
    /// exerts on it meets the line through the joint square to the guide.
    Centre {
        /// The link.
        of: LinkId,
        /// What the frame exerts on it.
        line: Action,
        /// The joint at which it hangs.
        joint: PointId,
        /// Where the two lines come from, metres from the skeleton's origin.
        from: [[f64; 2]; 2],
        /// Metres from the skeleton's origin.
        at: [f64; 2],
    },
}

/// A governor, as its balance is told: the sleeve along its guide, moments of the arm with the ball, and M ω² r.
#[derive(Debug, Clone, PartialEq)]
pub struct Governor {
    /// The arm, by its place among the bodies.
    pub arm: usize,
    /// The same, as a link.
    pub link: LinkId,
    /// The sleeve, by its place among the bodies.
    pub sleeve: Option<usize>,
    /// The ball.
    pub centre: PointId,
    /// Kilograms.
    pub mass: f64,
    /// How far the ball is from the axis, metres.
    pub radius: f64,
    /// The foot of this distance on the axis, metres from the skeleton's origin.
    pub foot: [f64; 2],
    /// The ball, metres from the skeleton's origin.
    pub ball: [f64; 2],
    /// The roller or the bar between arm and sleeve, with its forces on both.
    pub hands_on: Option<(LinkId, Action, Action)>,
    /// Whether the speed is sought.
    pub sought: bool,
    /// Whether the polygon of the arm is wanted for what the frame exerts on it.
    pub closes: bool,
    /// The senses in which the sleeve is about to move.
    pub states: Vec<GovernorState>,
}

/// The balance of a governor in one sense of its sleeve.
#[derive(Debug, Clone, PartialEq)]
pub struct GovernorState {
    /// Which sense.
    pub share: Share,
    /// rad/s.
    pub omega: f64,
    /// M ω² r, newtons.
    pub centrifugal: f64,
    /// The forces on the sleeve along its guide.
    pub along: Option<AlongGuide>,
    /// Moments of the arm.
    pub moments: MomentBalance,
}

/// A known force on a sleeve: its size, whether only its part along the guide counts, and whether it is against what is found.
pub type OnSleeve = (Action, f64, bool, bool);

/// The forces on a sleeve along its guide: each with its size in newtons, that of a pin at the sleeve with its part along the
/// guide.
#[derive(Debug, Clone, PartialEq)]
pub struct AlongGuide {
    /// What is found, and whether only its part along the guide.
    pub found: (Action, f64, bool),
    /// What is known.
    pub terms: Vec<OnSleeve>,
    /// A force is inclined to the guide: the polygon gives its size.
    pub inclined: bool,
    /// The direction of the guide, radians.
    pub angle: f64,
}

/// What a group of higher class leaves open, found by proportion from what would have to hold it.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupTrial {
    /// The body at which it is told, by its place in the order of solution.
    pub told: usize,
    /// The links of the group, in the order in which they are balanced.
    pub links: Vec<LinkId>,
    /// What is held, what is left open, and the size of its force, SI.
    pub found: Vec<(TrialDriver, Closing, f64)>,
    /// Of one driver: what the loads alone need to hold it, and a unit of the force alone, SI.
    pub efforts: Option<[f64; 2]>,
}

/// The moment of a force or a torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MomentTerm {
    /// Of what.
    pub of: Turning,
    /// Its size: newtons with an arm, newton metres without one; not negative.
    pub size: f64,
    /// The arm as it is measured.
    pub arm: Option<Arm>,
    /// Its moment, ccw positive, N m.
    pub moment: f64,
}

/// What has a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Turning {
    /// A force.
    Force(Action),
    /// The part of a force along the line of a link.
    Along(Action),
    /// The part of a force across it.
    Across(Action),
    /// A torque.
    Torque(Force),
}

/// The arm of a force: from a point square to its line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Arm {
    /// Metres.
    pub length: f64,
    /// Its foot on the line, metres from the skeleton's origin.
    pub foot: Mm2,
    /// The points between which it lies, where it is the distance of two.
    pub between: Option<[PointId; 2]>,
}

/// A force on a free body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Acting {
    /// Which.
    pub action: Action,
    /// Where it acts, metres from the skeleton's origin.
    pub at: Mm2,
    /// A point of its line; elsewhere where a couple shifts it.
    pub through: Mm2,
    /// Its components, newtons.
    pub force: [f64; 2],
    /// What was known of it when its body was cut free.
    pub known: Knowledge,
    /// The polygon of its body finds it.
    pub closes: bool,
    /// Its line would lie off the paper: it stands where it acts, with its couple beside it.
    pub with_couple: bool,
    /// The parts of which moments give one, or both.
    pub parts: Option<Parts>,
    /// What a pair does that passes on no force: a couple, ccw positive, N·m. Zero of every force that has a size, whose
    /// line tells its moment.
    pub couple: f64,
}

impl Acting {
    /// Whether nothing is passed on: neither a force nor a couple.
    #[must_use]
    pub fn acts_not(&self) -> bool {
        self.force == [0.0; 2] && self.couple == 0.0
    }
}

/// The parts of a force at a pin: head to tail they are the force.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Parts {
    /// The part across the line from another pin to this one, newtons.
    pub across: [f64; 2],
    /// The part along that line, newtons.
    pub along: [f64; 2],
    /// The other pin, and this one.
    pub line: [PointId; 2],
    /// Friction lets the forces touch circles of the pins: the line is not quite that of their middles.
    pub touches: bool,
}

/// What is known of a force before a body is balanced.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Knowledge {
    /// Size, line and sense.
    Full,
    /// Its line.
    Line,
    /// Nothing but where it acts.
    Nothing,
}

/// A value to more digits than a double has.
#[derive(Debug, Clone, PartialEq)]
pub struct Fine {
    /// SI units; two for a vector, one for a scalar.
    pub value: Vec<DoubleDouble>,
    /// How far it may be from the truth.
    pub bound: f64,
}

/// The mechanism in another position than the scene's.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherPosition {
    /// In what it is another.
    pub kind: OtherKind,
    /// Places by [`PointId`], metres from the skeleton's origin.
    pub places: Vec<Option<[f64; 2]>>,
    /// How links stand there whose own axes were laid, by [`LinkId`], their origins in metres from the skeleton's.
    pub axes: Vec<Option<Axes>>,
}

/// In what a position differs from the scene's.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum OtherKind {
    /// The first input stands elsewhere: rad, or m for a slide.
    Input(f64),
    /// The same input in another assembly.
    Assembly,
}

/// The skeleton as drawn.
#[derive(Debug, Clone)]
pub struct Space {
    /// Metres per millimetre of paper.
    pub metres_per_mm: f64,
    /// Place of each point by [`PointId`]; `None` where no asked quantity needed it.
    pub places: Vec<Option<Mm2>>,
    /// How links stand whose own axes were laid on the skeleton, by [`LinkId`].
    pub axes: Vec<Option<Axes>>,
    /// Arcs, rays and guide lines by which places were found.
    pub lines: Vec<ConstructionLine>,
    /// How it is assembled: which of the possible places was taken at each choice, in the order of drawing.
    /// Two skeletons of one mechanism, with other dimensions or in another position, are assembled alike
    /// where these are equal.
    pub choices: Vec<usize>,
}

impl Space {
    /// How large the skeleton is in reality: the diagonal of its places, m; 0 where none stands.
    #[must_use]
    pub fn size(&self) -> f64 {
        let extent = |axis: usize| {
            let all = || self.places.iter().flatten().map(|at| at[axis]);
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        libm::hypot(extent(0).max(0.0), extent(1).max(0.0)) * self.metres_per_mm
    }
}

/// A link's own axes on the skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axes {
    /// Their origin, in millimetres of paper where nothing else is said.
    pub origin: Mm2,
    /// Unit vector along the x-axis.
    pub x: [f64; 2],
}

/// The instant centres that were found, and in which order.
#[derive(Debug, Clone, PartialEq)]
pub struct CircleDiagram {
    /// The links on the circle: all of the mechanism.
    pub links: Vec<LinkId>,
    /// The centres that were wanted.
    pub wanted: Vec<[LinkId; 2]>,
    /// The centres found: the primary ones, then one per step.
    pub centres: Vec<Centre>,
    /// Wanted centres to which no construction led.
    pub stalled: Vec<[LinkId; 2]>,
    /// Those among them whose links do not move against each other: there is no centre.
    pub still: Vec<[LinkId; 2]>,
    /// The velocities that were asked for by a method of centres.
    pub transfers: Vec<Transfer>,
}

impl CircleDiagram {
    /// The centre of two links, where it was found.
    #[must_use]
    pub fn centre(&self, links: [LinkId; 2]) -> Option<&Centre> {
        self.centres.iter().find(|c| c.links == links)
    }

    /// Which centres were marked, which constructed by which triangles, and how many were left out, as text.
    #[must_use]
    pub fn explain<'a>(&'a self, mechanism: &'a Mechanism) -> CircleExplanation<'a> {
        CircleExplanation { circle: self, mechanism }
    }

    /// How many centres the mechanism has: N = n (n − 1) / 2.
    #[must_use]
    pub fn count(&self) -> usize {
        self.links.len() * self.links.len().saturating_sub(1) / 2
    }
}

/// The text of [`CircleDiagram::explain`].
#[derive(Debug, Clone, Copy)]
pub struct CircleExplanation<'a> {
    circle: &'a CircleDiagram,
    mechanism: &'a Mechanism,
}

impl fmt::Display for CircleExplanation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number = |l: LinkId| self.mechanism.link(l).number;
        let name = |links: [LinkId; 2]| format!("I({},{})", number(links[0]), number(links[1]));
        let primary: Vec<String> =
            self.circle.centres.iter().filter(|c| c.found.is_primary()).map(|c| name(c.links)).collect();
        writeln!(f, "kept    primary centres: {}", primary.join(", "))?;
        for centre in self.circle.centres.iter().filter(|c| !c.found.is_primary()) {
            let [i, j] = centre.links;
            let how = match centre.found {
                Found::Kennedy { lines } => {
                    let line = |line: CentreLine| match line {
                        CentreLine::Via(k) => format!("triangle {}-{}-{}", number(i), number(k), number(j)),
                        CentreLine::Normal(_) => "the common normal of the contact".to_owned(),
                    };
                    format!("{} and {}", line(lines[0]), line(lines[1]))
                }
                _ => "the velocity polygon, where the circle diagram stalls".to_owned(),
            };
            writeln!(f, "kept    centre {}: {how}", name(centre.links))?;
        }
        for &stalled in &self.circle.stalled {
            let [i, j] = stalled;
            if self.circle.still.contains(&stalled) {
                let (i, j) = (number(i), number(j));
                writeln!(
                    f,
                    "stalled centre {}: links {i} and {j} do not move against each other",
                    name(stalled)
                )?;
            } else {
                writeln!(f, "stalled centre {}: no two triangles lead to it", name(stalled))?;
            }
        }
        let found = self.circle.centres.len() + self.circle.stalled.len();
        writeln!(
            f,
            "skipped {} of {} centres (nothing asked needs them)",
            self.circle.count() - found,
            self.circle.count()
        )
    }
}

/// A velocity that was carried over from the input by instant centres, on the skeleton.
#[derive(Debug, Clone, PartialEq)]
pub struct Transfer {
    /// Index of the asked quantity.
    pub asked: usize,
    /// By which construction.
    pub method: Method,
    /// m/s per millimetre of the arrows.
    pub si_per_mm: f64,
    /// What is calculated and read, in order.
    pub acts: Vec<TransferAct>,
    /// What is drawn, in order.
    pub ink: Vec<TransferInk>,
}

/// A point of the skeleton, or an instant centre.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Spot {
    /// A point of the mechanism.
    Point(PointId),
    /// The centre of two links, the lower first.
    Centre([LinkId; 2]),
    /// The point of a link under a pin of another.
    Under(PointId, LinkId),
}

/// A calculation or reading of a transfer. Lengths of paper in mm, the rest SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransferAct {
    /// ω_k : ω_i = (1i–ik) : (1k–ik).
    Ratio {
        /// The input link i.
        input: LinkId,
        /// The sought link k.
        link: LinkId,
        /// (1i–ik) and (1k–ik) on paper.
        mm: [f64; 2],
        /// ω_i and ω_k, signed.
        omegas: [f64; 2],
    },
    /// V of the common centre of two links, as a point of the first: ω (1i–ik).
    CommonSpeed {
        /// The two links, whose centre has one velocity in both.
        links: [LinkId; 2],
        /// The link whose ω is known.
        of: LinkId,
        /// Distance from its pole on paper.
        mm: f64,
        /// Its ω, signed.
        omega: f64,
        /// V, not negative.
        speed: f64,
    },
    /// V of a point: ω times its distance from the pole of its link.
    AboutPole {
        /// The link.
        link: LinkId,
        /// The point.
        point: PointId,
        /// Distance from the pole on paper.
        mm: f64,
        /// ω, signed.
        omega: f64,
        /// V, not negative.
        speed: f64,
    },
    /// The link's pole is at infinity: all its points have one velocity.
    Translation {
        /// The link.
        link: LinkId,
        /// V, not negative.
        speed: f64,
    },
    /// The velocity of one point against another: the difference of two that stand at one place.
    Difference {
        /// The relative velocity.
        quantity: Quantity,
        /// Whose velocity it is.
        of: Spot,
        /// Against whose.
        against: Spot,
        /// From tip to tip on paper.
        mm: f64,
        /// Its magnitude, not negative.
        speed: f64,
    },
    /// V of a point read at the gauge line.
    Gauge {
        /// Where the known velocity stands.
        from: Spot,
        /// The point.
        point: PointId,
        /// V on paper.
        mm: f64,
        /// V, not negative.
        speed: f64,
    },
    /// V of the next pin cut off by a parallel to the link.
    Parallel {
        /// The link.
        link: LinkId,
        /// The pin whose velocity was known.
        from: PointId,
        /// The next one.
        to: PointId,
        /// Both pins and the pole are in one line: V is in proportion to the distance from the pole.
        flat: bool,
        /// V on paper.
        mm: f64,
        /// V, not negative.
        speed: f64,
    },
    /// ω = V / (distance from the pole).
    Omega {
        /// The link.
        link: LinkId,
        /// Where V is known.
        spot: Spot,
        /// Distance from the pole on paper.
        mm: f64,
        /// V, not negative.
        speed: f64,
        /// ω, signed.
        omega: f64,
    },
    /// ω from how much longer A′B′ is than AB: its pole may be off the sheet.
    OmegaByParallel {
        /// The link.
        link: LinkId,
        /// A.
        from: PointId,
        /// B.
        to: PointId,
        /// Both pins and the pole are in one line: B′ is found by proportion.
        flat: bool,
        /// A′B′ (signed along AB) and AB on paper.
        mm: [f64; 2],
        /// ω, signed.
        omega: f64,
    },
}

/// A stroke of a transfer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TransferInk {
    /// A piece of a line of centres.
    LineOfCentres {
        /// A pole.
        from: Mm2,
        /// The common centre.
        to: Mm2,
    },
    /// From a pole to a point of its link.
    Radius {
        /// The pole.
        from: Mm2,
        /// The point.
        to: Mm2,
    },
    /// A velocity's arrow.
    Velocity {
        /// Its tail.
        at: Mm2,
        /// Its tip.
        tip: Mm2,
        /// Whose velocity.
        of: Spot,
    },
    /// A relative velocity, from the tip of one arrow to that of another at the same place.
    Difference {
        /// Where both arrows stand.
        foot: Mm2,
        /// The tip of the arrow that is taken away.
        from: Mm2,
        /// The tip of the other.
        to: Mm2,
        /// The relative velocity.
        of: Quantity,
    },
    /// A velocity's arrow turned by 90°: A A′.
    Turned {
        /// A.
        at: Mm2,
        /// A′.
        tip: Mm2,
        /// Whose velocity.
        of: PointId,
    },
    /// A gauge line from a pole.
    Gauge {
        /// The pole.
        from: Mm2,
        /// Its far end.
        to: Mm2,
        /// Where the arrow stands that ends there.
        foot: Mm2,
    },
    /// The arc on which a point is turned about a pole.
    Arc {
        /// The pole.
        centre: Mm2,
        /// The point.
        from: Mm2,
        /// Where it comes to lie.
        to: Mm2,
    },
    /// The perpendicular from the turned point to the gauge line.
    Upright {
        /// Its foot.
        from: Mm2,
        /// On the gauge line.
        to: Mm2,
    },
    /// The parallel to a link.
    Parallel {
        /// A′.
        from: Mm2,
        /// B′.
        to: Mm2,
        /// A and B.
        link: [Mm2; 2],
    },
    /// The line from a pin toward the pole of its link.
    ToPole {
        /// The pin.
        from: Mm2,
        /// B′.
        to: Mm2,
    },
}

/// An instant centre on the skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Centre {
    /// Its two links, the lower first.
    pub links: [LinkId; 2],
    /// Where it lies.
    pub place: CentrePlace,
    /// How it was found.
    pub found: Found,
}

/// Where an instant centre lies on the skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CentrePlace {
    /// On the plane of the paper, however far off the sheet.
    At(Mm2),
    /// At infinity in the direction of this unit vector, whose sign has no meaning.
    Toward([f64; 2]),
}

/// How an instant centre was found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    /// Primary: a turning pair.
    Pin(PointId),
    /// Primary: a straight guide, by index of the sliding pair; the centre is at infinity.
    Guide {
        /// Index of the sliding pair.
        slide: usize,
    },
    /// Primary: the centre of curvature of an arc guide.
    ArcGuide {
        /// Index of the sliding pair.
        slide: usize,
    },
    /// Primary: the contact point of a rolling pair.
    Rolling {
        /// Index of the rolling pair.
        roll: usize,
    },
    /// By Kennedy's theorem: where two lines of centres meet.
    Kennedy {
        /// The two lines.
        lines: [CentreLine; 2],
    },
    /// From the velocity polygon: on the normal to V of a point of one link seen from the other, at the distance V / ω.
    Normal {
        /// The point.
        point: PointId,
        /// Its link.
        link: LinkId,
        /// The link from which it is seen.
        from: LinkId,
        /// The mechanism rests: the velocities are those with an assumed rate of its input.
        assumed: bool,
    },
}

impl Found {
    /// Seen from the pairs, without construction.
    #[must_use]
    pub fn is_primary(&self) -> bool {
        matches!(self, Self::Pin(_) | Self::Guide { .. } | Self::ArcGuide { .. } | Self::Rolling { .. })
    }
}

/// A vector diagram with its pole at (0, 0).
#[derive(Debug, Clone)]
pub struct Diagram {
    /// What it shows.
    pub kind: DiagramKind,
    /// SI units of its dimension per millimetre of paper.
    pub si_per_mm: f64,
    /// Image points and feet. The pole itself is not listed.
    pub images: Vec<Image>,
    /// Vectors, in the order of drawing.
    pub vectors: Vec<Vector>,
    /// Construction lines, in the order of drawing.
    pub lines: Vec<ConstructionLine>,
    /// Images of links with three or more points: corners in the order of the link's points.
    pub link_images: Vec<LinkImage>,
}

impl Diagram {
    /// Whether every vector in it is zero.
    #[must_use]
    pub fn rests(&self) -> bool {
        self.vectors.iter().all(|vector| vector.from == vector.to)
    }

    /// The image of a point itself: not that of the point of another link under it.
    #[must_use]
    pub fn image_of(&self, point: PointId, mechanism: &Mechanism) -> Option<Image> {
        self.images.iter().find(|image| image.label.is_of(point, mechanism)).copied()
    }
}

/// Name of a point of a polygon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Label {
    /// o or o′.
    Pole,
    /// a, b′ … image of a point; `link` where coincident points must be told apart (a₂, a₄).
    Image {
        /// The point.
        point: PointId,
        /// The link whose point it is, where that matters.
        link: Option<LinkId>,
    },
    /// a′₁, b′₂ …: the end of a component. 1 is the normal part laid off first, 2 the one laid off
    /// from the other point, and so on.
    Foot {
        /// The point whose image the component leads to.
        point: PointId,
        /// The link whose point it is, where that matters.
        link: Option<LinkId>,
        /// 1, 2, …
        index: u8,
    },
    /// c_I, c_II: the image of a point in one of two trial polygons.
    Trial {
        /// The point.
        point: PointId,
        /// Whether it is the second of them.
        second: bool,
    },
}

impl Label {
    /// Whether it names the image of this point itself: not that of the point of another link under it.
    #[must_use]
    pub fn is_of(self, point: PointId, mechanism: &Mechanism) -> bool {
        matches!(self, Self::Image { point: own, link }
            if own == point && link.is_none_or(|link| mechanism.link(link).points.contains(&point)))
    }
}

/// A labelled point of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Image {
    /// Its name.
    pub label: Label,
    /// Its place.
    pub at: Mm2,
}

/// The image of a rigid link, to be lightly filled; it has the link's own reading sense.
#[derive(Debug, Clone, PartialEq)]
pub struct LinkImage {
    /// The link.
    pub link: LinkId,
    /// The corners, in the order of the link's points.
    pub corners: Vec<(PointId, Mm2)>,
}

/// What a vector of a polygon is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VectorKind {
    /// From the pole to an image point. Thick.
    Absolute,
    /// From one image point to another. Thick.
    Relative,
    /// A normal part. Thin.
    Normal,
    /// A tangential part. Thin.
    Tangential,
    /// Velocity or apparent acceleration along a guide. Thin.
    Sliding,
    /// Coriolis acceleration; its head is at the known point. Thin.
    Coriolis,
}

/// A vector of a polygon.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Vector {
    /// What it is.
    pub kind: VectorKind,
    /// Which quantity it represents.
    pub quantity: Quantity,
    /// Name of its tail.
    pub tail: Label,
    /// Name of its head.
    pub head: Label,
    /// Place of its tail.
    pub from: Mm2,
    /// Place of its head.
    pub to: Mm2,
    /// The direction it claims to have.
    pub claim: Option<Claim>,
    /// Shorter than 1 mm of the page: drawn as a point.
    pub as_point: bool,
    /// Its bound cannot tell it from zero: it is drawn as a point, and nothing else is told of it.
    pub is_zero: bool,
    /// Index into [`Construction::steps`].
    pub step: usize,
}

impl Vector {
    /// How long it is drawn, mm.
    #[must_use]
    pub fn length(&self) -> f64 {
        libm::hypot(self.to[0] - self.from[0], self.to[1] - self.from[1])
    }
}

/// A line of the skeleton that a direction refers to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reference {
    /// The line through two points.
    Points(PointId, PointId),
    /// The guide of a sliding pair (its direction under the rider), by index of the pair.
    Guide(usize),
}

/// The direction that a drawn line claims to have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Claim {
    /// ∥ to a line of the skeleton.
    Parallel(Reference),
    /// ⊥ to a line of the skeleton.
    Perpendicular(Reference),
}

/// A thin line of the construction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ConstructionLine {
    /// A straight line of unknown length, from its start through the intersection it helped to find.
    Ray {
        /// Where it starts.
        from: Mm2,
        /// The intersection that ends its use; it is drawn a little past it.
        to: Mm2,
        /// The direction it claims to have.
        claim: Option<Claim>,
        /// Index into [`Construction::steps`].
        step: usize,
    },
    /// An arc struck with the compass near an intersection.
    Arc {
        /// Where the compass stands.
        centre: Mm2,
        /// Its opening.
        radius: f64,
        /// The intersection it helped to find.
        at: Mm2,
        /// Index into [`Construction::steps`].
        step: usize,
    },
}

/// One numbered step of the solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Step {
    /// The diagram in which it is drawn.
    pub diagram: DiagramKind,
    /// The links that this step solves; empty where it solves none (pole, frame).
    pub links: Vec<LinkId>,
    /// The vector equations of the step.
    pub equations: Vec<Equation>,
    /// What the draughtsman does, in order.
    pub acts: Vec<Act>,
}

/// A vector equation: one vector by two routes, or itself and a route of which all is known.
#[derive(Debug, Clone, PartialEq)]
pub struct Equation {
    /// The step's act with which its drawing begins: it is told before what is drawn there.
    pub begins: usize,
    /// The vector itself, where it is sought by two routes and neither begins at the pole.
    pub whole: Option<Term>,
    /// Left-hand side: parts of the vector by the first route.
    pub left: Vec<Term>,
    /// Right-hand side: the same vector by the second route.
    pub right: Vec<Term>,
}

impl Equation {
    /// All its terms, in the order in which they are written.
    pub fn terms(&self) -> impl Iterator<Item = &Term> {
        self.whole.iter().chain(&self.left).chain(&self.right)
    }

    /// Whether a line of unknown length is drawn for it; else one side of it is laid off, and gives the other.
    #[must_use]
    pub fn has_unknowns(&self) -> bool {
        self.left.iter().chain(&self.right).any(|term| term.magnitude.is_none() && term.direction.is_some())
    }
}

/// One term of a vector equation, as the table of terms shows it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Term {
    /// The vector.
    pub quantity: Quantity,
    /// Its magnitude in SI units if it was known before the step was drawn.
    pub magnitude: Option<f64>,
    /// Its direction if it was known before the step was drawn.
    pub direction: Option<TermDirection>,
}

/// A direction known before drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TermDirection {
    /// Fully found already (a vector of the diagram).
    Found,
    /// By a line of the skeleton.
    Claim(Claim),
}

/// An act of the draughtsman, or a calculation between two of them. Values are SI, lengths of paper mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Act {
    /// Mark the given places of the frame, or of placed points.
    MarkPlaces,
    /// From a known joint lay off a link at its given angle.
    LayOffLink {
        /// The link.
        link: LinkId,
        /// Known joint.
        from: PointId,
        /// New joint.
        to: PointId,
        /// Angle from +x in radians, as measured with the protractor.
        angle: f64,
        /// Length in metres.
        length: f64,
    },
    /// From a point that stands lay off another one that is stated by distance and direction.
    LayOffPlace {
        /// The point that stands.
        from: PointId,
        /// The stated point.
        to: PointId,
        /// Angle from +x in radians.
        angle: f64,
        /// Length in metres.
        length: f64,
    },
    /// Draw the ray on which a point is stated.
    DrawStatedRay {
        /// Where it begins.
        from: PointId,
        /// The stated point.
        to: PointId,
        /// Angle from +x in radians.
        angle: f64,
    },
    /// Draw the line through a point that is square to another line.
    DrawSquare {
        /// The point.
        through: PointId,
        /// Two points of the other line.
        to: [PointId; 2],
    },
    /// Draw the circle from which a segment is seen at an angle.
    DrawSeeing {
        /// The ends of the segment.
        ends: [PointId; 2],
        /// The angle in radians, ccw.
        angle: f64,
    },
    /// Draw the line or the arc on which a point is stated to lie.
    DrawPath {
        /// The stated point.
        point: PointId,
    },
    /// Strike an arc about a known point.
    StrikeArc {
        /// Where the compass stands.
        centre: PointId,
        /// The point that lies on the arc.
        to: PointId,
        /// Radius in metres.
        radius: f64,
    },
    /// From the pin of a rod lay off a line of a driven link, equal and parallel.
    LayOffShift {
        /// The pin.
        base: PointId,
        /// The points of the link between which the line runs.
        line: [PointId; 2],
        /// Angle from +x in radians.
        angle: f64,
        /// Length in metres.
        length: f64,
    },
    /// About the end of what was laid off so strike the rod's arc.
    StrikeArcThere {
        /// The rod's ends: its length is the radius.
        ends: [PointId; 2],
        /// The point that lies on the arc.
        point: PointId,
        /// Radius in metres.
        radius: f64,
    },
    /// Draw the path of a rolling wheel's centre: the parallel to the line on which it rolls, or the circle about the other
    /// wheel's centre.
    DrawCentrePath {
        /// The centre.
        centre: PointId,
        /// The rolling pair.
        roll: usize,
    },
    /// Lay off a driven place along a guide that is drawn.
    LayOffAlong {
        /// Index of the sliding pair.
        slide: usize,
        /// The point found.
        point: PointId,
        /// Length along the guide in metres.
        length: f64,
    },
    /// Draw the line of a fixed guide.
    DrawGuide {
        /// Index of the sliding pair.
        slide: usize,
    },
    /// Mark an intersection of the skeleton.
    MarkIntersection {
        /// The point found.
        point: PointId,
        /// Angle at which the two lines cross, radians, 0 to π/2; flatter than 3° is badly readable.
        crossing: f64,
    },
    /// Transfer a further point of a link whose pose is now known.
    TransferPoint {
        /// The link.
        link: LinkId,
        /// The point.
        point: PointId,
    },
    /// Measure a length that was not given off the skeleton.
    MeasureLength {
        /// One end.
        from: PointId,
        /// Other end.
        to: PointId,
        /// Length on paper in mm.
        mm: f64,
        /// Length in metres.
        value: f64,
    },
    /// Draw the line of a rack that is pinned to a known joint so that it touches a wheel whose centre stands.
    DrawTouching {
        /// The rack.
        link: LinkId,
        /// Its pin.
        base: PointId,
        /// The wheel's centre.
        centre: PointId,
        /// How far the rack's line runs from the pin, metres; zero where it runs through it.
        offset: f64,
        /// The wheel's radius in metres.
        radius: f64,
    },
    /// Mark the contact point of a rolling pair.
    MarkContact {
        /// The contact point.
        contact: PointId,
    },
    /// Find by trial the angle of a link, or the place of a rider, at which the group closes.
    TryPosition {
        /// What is moved by trial.
        driver: TrialDriver,
        /// The constraint that is left open.
        closing: Closing,
        /// Whether it is a group of turning pairs and pins on guides of more than two links, with nothing driven in it: then
        /// no dyad of it is solvable alone.
        of_no_dyad: bool,
    },
    /// Draw two trial polygons.
    TryPolygon {
        /// The trial driver.
        driver: TrialDriver,
        /// The constraint that is left open.
        closing: Closing,
        /// Velocity or acceleration.
        order: Order,
        /// The assumed rates of the one and of the other, SI, signed.
        rates: [f64; 2],
    },
    /// The rate of the trial driver, by proportion.
    TrialRate {
        /// The trial driver.
        driver: TrialDriver,
        /// Velocity or acceleration.
        order: Order,
        /// ω or ε, or the rate along the guide, SI, signed.
        rate: f64,
        /// By how much the two trial polygons miss what was left open, SI, signed; none where their images tell that.
        missed: Option<[f64; 2]>,
    },
    /// Choose the pole.
    MarkPole,
    /// Calculate a magnitude that the next acts lay off.
    Calculate(Calculation),
    /// Lay off a vector of known magnitude and direction.
    LayOffVector {
        /// Index into [`Diagram::vectors`].
        vector: usize,
        /// Its magnitude in SI units.
        value: f64,
        /// Its length on paper in mm.
        mm: f64,
    },
    /// Through a point draw a line of known direction and unknown length.
    DrawRay {
        /// The point.
        from: Label,
        /// The direction.
        claim: Claim,
    },
    /// Mark where two rays meet.
    MarkMeet {
        /// The image found.
        label: Label,
        /// Angle at which the two rays cross, radians, 0 to π/2.
        crossing: f64,
    },
    /// The centre of a wheel that rolls on a straight line at rest keeps its distance: A = ε r.
    RollStraight {
        /// The wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
    },
    /// At a rolling contact only the tangential parts count: what lies along the common normal is not drawn.
    LeaveOutNormals {
        /// The contact point.
        contact: PointId,
        /// The centre of the wheel whose turning is sought.
        centre: PointId,
    },
    /// Divide an image line as the link is divided.
    DivideImage {
        /// The image found.
        label: Label,
        /// Start of the image line.
        from: Label,
        /// End of the image line.
        to: Label,
        /// from→found : from→to, signed.
        ratio: f64,
    },
    /// Complete the image of a link similar to the link and in the same reading sense.
    CompleteImage {
        /// The image found.
        label: Label,
        /// The link.
        link: LinkId,
        /// Base of the similar figure.
        base: [Label; 2],
    },
    /// The whole link shares one image point (ω = 0, translation).
    SameImage {
        /// The image.
        label: Label,
        /// The image it coincides with.
        with: Label,
    },
    /// Part of how a velocity that is laid off next follows from centres.
    ByCentres(TransferAct),
    /// Lay off a velocity that was found from a link's instant centre with the frame.
    LayOffFromCentre {
        /// Index into [`Diagram::vectors`].
        vector: usize,
        /// The link.
        link: LinkId,
        /// Its magnitude in SI units.
        value: f64,
        /// Its length on paper in mm.
        mm: f64,
    },
    /// Read a vector off the diagram.
    ReadVector {
        /// Index into [`Diagram::vectors`].
        vector: usize,
        /// Its length on paper in mm.
        mm: f64,
        /// Its magnitude in SI units.
        value: f64,
    },
}

/// A calculation of the textbook, between reading and laying off. Values are SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Calculation {
    /// V = ω l, for a driven link.
    Speed {
        /// The vector.
        quantity: Quantity,
        /// The link.
        link: LinkId,
        /// The length, by its ends.
        ends: [PointId; 2],
        /// ω, signed.
        omega: f64,
        /// l.
        length: f64,
        /// V, not negative.
        value: f64,
    },
    /// ω = V / l.
    Omega {
        /// The link.
        link: LinkId,
        /// The vector that was read.
        quantity: Quantity,
        /// The length, by its ends.
        ends: [PointId; 2],
        /// V, not negative.
        speed: f64,
        /// l.
        length: f64,
        /// ω, signed, ccw positive.
        value: f64,
    },
    /// Aⁿ = V² / l.
    Normal {
        /// The vector.
        quantity: Quantity,
        /// The velocity that was read.
        velocity: Quantity,
        /// The length, by its ends.
        ends: [PointId; 2],
        /// V, not negative.
        speed: f64,
        /// l.
        length: f64,
        /// Aⁿ, not negative.
        value: f64,
    },
    /// Aᵗ = ε l, for a link whose ε is known.
    Tangential {
        /// The vector.
        quantity: Quantity,
        /// The link.
        link: LinkId,
        /// The length, by its ends.
        ends: [PointId; 2],
        /// ε, signed.
        alpha: f64,
        /// l.
        length: f64,
        /// Aᵗ, not negative.
        value: f64,
    },
    /// ε = Aᵗ / l.
    Alpha {
        /// The link.
        link: LinkId,
        /// The vector that was read.
        quantity: Quantity,
        /// The length, by its ends.
        ends: [PointId; 2],
        /// Aᵗ, not negative.
        tangential: f64,
        /// l.
        length: f64,
        /// ε, signed, ccw positive.
        value: f64,
    },
    /// Aᶜ = 2 V ω, V the sliding velocity, ω that of the link that carries the guide; V turned by 90° in
    /// the sense of ω.
    Coriolis {
        /// The vector.
        quantity: Quantity,
        /// The link that carries the guide.
        link: LinkId,
        /// The sliding velocity.
        slip: Quantity,
        /// V, not negative.
        speed: f64,
        /// ω, signed.
        omega: f64,
        /// Aᶜ, not negative.
        value: f64,
    },
    /// V² / R, the normal part of sliding along an arc.
    SlipNormal {
        /// The vector.
        quantity: Quantity,
        /// The sliding velocity.
        slip: Quantity,
        /// V, not negative.
        speed: f64,
        /// R.
        radius: f64,
        /// The normal part, not negative.
        value: f64,
    },
    /// A link that only translates: ω = 0, ε = 0.
    Translation {
        /// The link.
        link: LinkId,
    },
    /// V_r = r |ω_i − ω_j|.
    Rub {
        /// The pin.
        pin: PointId,
        /// The two links.
        links: [LinkId; 2],
        /// Journal radius.
        radius: f64,
        /// ω of the first.
        first: f64,
        /// ω of the second.
        second: f64,
        /// The rubbing speed.
        value: f64,
    },
}
