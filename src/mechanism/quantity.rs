//! What a scene may ask for, and what a solver may answer.

use std::fmt;

use super::cycle::CycleQuantity;
use super::force::{Action, Force, Share};
use super::{LinkId, Mechanism, PointId};

/// A quantity by its meaning. "Relative to" reads from the second operand to the first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// `v(B)`: velocity of a point. Vector.
    Velocity(PointId),
    /// `v(B/A)`: velocity of B relative to A. Vector.
    RelativeVelocity(PointId, PointId),
    /// `a(B)`: acceleration of a point. Vector.
    Acceleration(PointId),
    /// `a(B/A)`: acceleration of B relative to A. Vector.
    RelativeAcceleration(PointId, PointId),
    /// `an(B/A)`: normal part, B and A of one link. Vector.
    RelativeNormal(PointId, PointId),
    /// `at(B/A)`: tangential part, B and A of one link. Vector.
    RelativeTangential(PointId, PointId),
    /// `an(B)`: normal part for a point of a link pivoted to the frame. Vector.
    Normal(PointId),
    /// `at(B)`: tangential part for a point of a link pivoted to the frame. Vector.
    Tangential(PointId),
    /// `omega(3)`: angular velocity. Signed scalar, ccw positive.
    Omega(LinkId),
    /// `omega(3/2)`: ω₃ − ω₂. Signed scalar.
    RelativeOmega(LinkId, LinkId),
    /// `ratio(4/2)`: ω₄ : ω₂. Signed number, positive where both turn the same way.
    Ratio(LinkId, LinkId),
    /// `advantage(4/2)`: mechanical advantage, the torque at link 4 for a unit of torque at link 2 without losses,
    /// ω₂ : ω₄. Signed number.
    Advantage(LinkId, LinkId),
    /// `alpha(3)`: angular acceleration. Signed scalar, ccw positive.
    Alpha(LinkId),
    /// `alpha(3/2)`: α₃ − α₂. Signed scalar.
    RelativeAlpha(LinkId, LinkId),
    /// `slip(A/4)`: velocity of pin A relative to the point of link 4 under it. Vector.
    Slip(PointId, LinkId),
    /// `aslip(A/4)`: apparent acceleration of pin A in link 4, without Coriolis. Vector.
    SlipAcceleration(PointId, LinkId),
    /// `aslipn(A/4)`: its part normal to an arc guide. Vector.
    SlipNormal(PointId, LinkId),
    /// `aslipt(A/4)`: its part along an arc guide. Vector.
    SlipTangential(PointId, LinkId),
    /// `coriolis(A/4)`: 2 ω₄ × slip. Vector.
    Coriolis(PointId, LinkId),
    /// `v(A@4)`: velocity of the point of link 4 that lies under A. Vector.
    CoincidentVelocity(PointId, LinkId),
    /// `a(A@4)`: acceleration of the point of link 4 that lies under A. Vector.
    CoincidentAcceleration(PointId, LinkId),
    /// `an(A@4)`: its normal part about the link's fixed pivot. Vector.
    CoincidentNormal(PointId, LinkId),
    /// `at(A@4)`: its tangential part about the link's fixed pivot. Vector.
    CoincidentTangential(PointId, LinkId),
    /// What the turning of a link gives the point of it under the first pin against that under the second: of velocities
    /// ω × r. One of them at least is no point of the link. Vector; drawn, not asked.
    TurningVelocity(PointId, PointId, LinkId),
    /// The same of accelerations, the normal part −ω² r. Vector; drawn, not asked.
    TurningNormal(PointId, PointId, LinkId),
    /// The same of accelerations, the tangential part α × r. Vector; drawn, not asked.
    TurningTangential(PointId, PointId, LinkId),
    /// Acceleration of the point of the second link at a rolling contact relative to that of the third:
    /// along the common normal, never zero where the bodies are curved. Vector; drawn, not asked.
    ContactNormal(PointId, LinkId, LinkId),
    /// `I(1,3)`: instant centre. A place, or a direction where it is at infinity.
    Centre(LinkId, LinkId),
    /// `rub(B)`, `rub(B,3/4)`: rubbing speed at a pin, journal radius × |relative ω|. Scalar, not negative.
    Rub(PointId, LinkId, LinkId),
    /// `rho(B)`: radius of curvature of the path of a point. Scalar, not negative.
    PathRadius(PointId),
    /// `x(B)`: place of a point. Vector.
    Position(PointId),
    /// `angle(3)`: angle of a link's own x-axis from +x, in (−π, π]. Scalar.
    Angle(LinkId),
    /// `transmission(3/4)`: angle between coupler 3 and output 4 at their pin, 0 to π. Scalar.
    Transmission(LinkId, LinkId),
    /// `F(2,3)`, `T(2)`, `h(3)` and the like: a force, a torque, an arm.
    Force(Force, Share),
    /// `Ef`, `crossing(2)` and the like: a number of the turning-moment diagram. Scalar.
    Cycle(CycleQuantity),
}

/// Whether a quantity needs positions only, velocities, or accelerations.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Order {
    /// Positions suffice.
    Position,
    /// Velocities are needed.
    Velocity,
    /// Accelerations are needed.
    Acceleration,
}

impl Order {
    /// The diagram in which vectors of this order are drawn: for positions the skeleton.
    #[must_use]
    pub const fn diagram(self) -> DiagramKind {
        match self {
            Self::Position => DiagramKind::Skeleton,
            Self::Velocity => DiagramKind::Velocity,
            Self::Acceleration => DiagramKind::Acceleration,
        }
    }

    /// What vectors of this order are measured in.
    #[must_use]
    pub const fn dimension(self) -> Dimension {
        self.diagram().dimension()
    }
}

/// What a number measures.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Measure {
    /// Metres.
    Length,
    /// Radians.
    Angle,
    /// Metres a second.
    Velocity,
    /// Metres a second, a second.
    Acceleration,
    /// Radians a second.
    AngularVelocity,
    /// Radians a second, a second.
    AngularAcceleration,
    /// A pure number.
    Number,
    /// Newtons.
    Force,
    /// Kilograms.
    Mass,
    /// Newton metres: a torque, a work.
    Torque,
    /// Kilogram metres squared.
    Inertia,
    /// Newtons a metre.
    Stiffness,
    /// Newton metres a radian: of a torsion spring.
    TurningStiffness,
    /// Pascals.
    Pressure,
    /// Watts.
    Power,
    /// Metres squared.
    Area,
}

/// Of what nature the value of a quantity is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nature {
    /// A vector.
    Vector,
    /// A place: two coordinates.
    Place,
    /// A number whose sign is a sense of rotation, ccw positive.
    Rotation,
    /// A number with a sign.
    Signed,
    /// A number that is never negative, and has no sense.
    Size,
}

/// What a diagram of the solution shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum DiagramKind {
    /// The kinematic skeleton: the mechanism to scale.
    Skeleton,
    /// The velocity polygon.
    Velocity,
    /// The acceleration polygon.
    Acceleration,
}

impl DiagramKind {
    /// The name of its figure.
    #[must_use]
    pub const fn figure(self) -> &'static str {
        match self {
            Self::Skeleton => "skeleton",
            Self::Velocity => "velocity",
            Self::Acceleration => "acceleration",
        }
    }

    /// What its lengths on paper stand for.
    #[must_use]
    pub const fn dimension(self) -> Dimension {
        match self {
            Self::Skeleton => Dimension::Length,
            Self::Velocity => Dimension::Velocity,
            Self::Acceleration => Dimension::Acceleration,
        }
    }

    /// The order of the motion that it shows.
    #[must_use]
    pub const fn order(self) -> Option<Order> {
        match self {
            Self::Skeleton => Some(Order::Position),
            Self::Velocity => Some(Order::Velocity),
            Self::Acceleration => Some(Order::Acceleration),
        }
    }
}

/// What a length on paper stands for: each has one scale on a sheet.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dimension {
    /// Metres.
    Length,
    /// Metres a second.
    Velocity,
    /// Metres a second, a second.
    Acceleration,
}

impl Dimension {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Length, Self::Velocity, Self::Acceleration];
}

impl Quantity {
    /// The points and the links that its name names.
    #[must_use]
    pub fn about(&self) -> ([Option<PointId>; 2], [Option<LinkId>; 2]) {
        match *self {
            Self::Velocity(p)
            | Self::Acceleration(p)
            | Self::Normal(p)
            | Self::Tangential(p)
            | Self::PathRadius(p)
            | Self::Position(p) => ([Some(p), None], [None; 2]),
            Self::RelativeVelocity(p, o)
            | Self::RelativeAcceleration(p, o)
            | Self::RelativeNormal(p, o)
            | Self::RelativeTangential(p, o) => ([Some(p), Some(o)], [None; 2]),
            Self::Omega(l) | Self::Alpha(l) | Self::Angle(l) => ([None; 2], [Some(l), None]),
            Self::RelativeOmega(i, j)
            | Self::Ratio(i, j)
            | Self::Advantage(i, j)
            | Self::RelativeAlpha(i, j)
            | Self::Centre(i, j)
            | Self::Transmission(i, j) => ([None; 2], [Some(i), Some(j)]),
            Self::Slip(p, l)
            | Self::SlipAcceleration(p, l)
            | Self::SlipNormal(p, l)
            | Self::SlipTangential(p, l)
            | Self::CoincidentVelocity(p, l)
            | Self::CoincidentAcceleration(p, l)
            | Self::CoincidentNormal(p, l)
            | Self::CoincidentTangential(p, l)
            | Self::Coriolis(p, l) => ([Some(p), None], [Some(l), None]),
            Self::TurningVelocity(p, o, l)
            | Self::TurningNormal(p, o, l)
            | Self::TurningTangential(p, o, l) => ([Some(p), Some(o)], [Some(l), Some(l)]),
            Self::ContactNormal(p, i, j) => ([Some(p), None], [Some(i), Some(j)]),
            // The pin is on both links, and only their turning counts.
            Self::Rub(p, i, j) => ([Some(p), None], [Some(i), Some(j)]),
            Self::Force(force, _) => force.about(),
            Self::Cycle(_) => ([None; 2], [None; 2]),
        }
    }

    /// Of which kind it is: the table of all kinds.
    #[must_use]
    pub const fn kind(&self) -> Kind {
        use Measure as M;
        use Nature as N;
        use Order as O;
        Kind::Motion(match self {
            Self::Velocity(_) => Row::velocity("v(B)", "velocity of point B"),
            Self::RelativeVelocity(..) => Row::velocity("v(B/A)", "velocity of B relative to A"),
            Self::CoincidentVelocity(..) => Row::velocity(
                "v(A@4)",
                "velocity of the point of link 4 that lies under the sliding pin A (textbooks: A4)",
            ),
            Self::Acceleration(_) => Row::acceleration("a(B)", "acceleration of point B"),
            Self::RelativeAcceleration(..) => Row::acceleration("a(B/A)", "acceleration of B relative to A"),
            Self::CoincidentAcceleration(..) => {
                Row::acceleration("a(A@4)", "acceleration of the point of link 4 under the sliding pin A")
            }
            // Normal parts and Coriolis need velocities only, but they are vectors of the acceleration polygon.
            Self::RelativeNormal(..) => {
                Row::acceleration("an(B/A)", "normal part of a(B/A), for two points of one link")
            }
            Self::Normal(_) => {
                Row::acceleration("an(B)", "normal part of a(B), for a point of a link pivoted to the frame")
            }
            Self::CoincidentNormal(..) => {
                Row::acceleration("an(A@4)", "normal part of a(A@4), about the fixed pivot of link 4")
            }
            Self::TurningVelocity(..) => Row::velocity(
                "v(B@4/A@4)",
                "velocity of the point of link 4 under B relative to that under A",
            ),
            Self::TurningNormal(..) => Row::acceleration("an(B@4/A@4)", "normal part of its acceleration"),
            Self::TurningTangential(..) => {
                Row::acceleration("at(B@4/A@4)", "tangential part of its acceleration")
            }
            Self::ContactNormal(..) => Row::acceleration(
                "an(A@4/3)",
                "acceleration at the contact A of a point of link 4 relative to that of link 3",
            ),
            Self::RelativeTangential(..) => {
                Row::acceleration("at(B/A)", "tangential part of a(B/A), for two points of one link")
            }
            Self::Tangential(_) => Row::acceleration(
                "at(B)",
                "tangential part of a(B), for a point of a link pivoted to the frame",
            ),
            Self::CoincidentTangential(..) => {
                Row::acceleration("at(A@4)", "tangential part of a(A@4), about the fixed pivot of link 4")
            }
            Self::Omega(_) => Row::new(
                "omega(3)",
                "angular velocity of link 3, counter-clockwise positive",
                O::Velocity,
                M::AngularVelocity,
                N::Rotation,
            ),
            Self::RelativeOmega(..) => Row::new(
                "omega(3/2)",
                "angular velocity of link 3 relative to link 2",
                O::Velocity,
                M::AngularVelocity,
                N::Rotation,
            ),
            Self::Alpha(_) => Row::new(
                "alpha(3)",
                "angular acceleration of link 3, counter-clockwise positive",
                O::Acceleration,
                M::AngularAcceleration,
                N::Rotation,
            ),
            Self::RelativeAlpha(..) => Row::new(
                "alpha(3/2)",
                "angular acceleration of link 3 relative to link 2",
                O::Acceleration,
                M::AngularAcceleration,
                N::Rotation,
            ),
            Self::Ratio(..) => Row::new(
                "ratio(4/2)",
                "angular velocity of link 4 over that of link 2",
                O::Velocity,
                M::Number,
                N::Signed,
            ),
            Self::Advantage(..) => Row::new(
                "advantage(4/2)",
                "mechanical advantage: torque at link 4 for a unit of torque at link 2",
                O::Velocity,
                M::Number,
                N::Signed,
            ),
            Self::Slip(..) => {
                Row::velocity("slip(A/4)", "velocity of pin A along link 4, relative to the point under it")
            }
            Self::SlipAcceleration(..) => {
                Row::acceleration("aslip(A/4)", "acceleration of pin A as link 4 sees it, without Coriolis")
            }
            Self::SlipNormal(..) => {
                Row::acceleration("aslipn(A/4)", "the part of aslip(A/4) normal to an arc guide")
            }
            Self::SlipTangential(..) => {
                Row::acceleration("aslipt(A/4)", "the part of aslip(A/4) along an arc guide")
            }
            Self::Coriolis(..) => {
                Row::acceleration("coriolis(A/4)", "Coriolis acceleration of pin A on link 4")
            }
            Self::Centre(..) => {
                Row::new("I(1,3)", "instant centre of links 1 and 3", O::Velocity, M::Length, N::Place)
            }
            Self::Rub(..) => Row::new(
                "rub(B,3/4)",
                "the same at a pin of more than two links: between links 3 and 4",
                O::Velocity,
                M::Velocity,
                N::Size,
            ),
            Self::PathRadius(_) => Row::new(
                "rho(B)",
                "radius of curvature of the path of B",
                O::Acceleration,
                M::Length,
                N::Size,
            ),
            Self::Position(_) => Row::new("x(B)", "place of point B", O::Position, M::Length, N::Place),
            Self::Angle(_) => Row::new(
                "angle(3)",
                "angle of the own x-axis of link 3 from +x",
                O::Position,
                M::Angle,
                N::Signed,
            ),
            Self::Transmission(..) => Row::new(
                "transmission(3/4)",
                "angle between coupler 3 and output 4 at their pin, 0 to 180 degrees",
                O::Position,
                M::Angle,
                N::Size,
            ),
            Self::Force(force, share) => return Kind::Force(*force, *share),
            Self::Cycle(of) => return Kind::Cycle(*of),
        })
    }

    /// As a scene names it: `v(B/A)`.
    #[must_use]
    pub fn name(&self, mechanism: &Mechanism) -> String {
        match self.kind() {
            Kind::Motion(row) => {
                let (points, links) = self.about();
                let points = points.into_iter().flatten().map(|point| mechanism.point(point).name.clone());
                let links = links.into_iter().flatten().map(|link| mechanism.link(link).number.to_string());
                row.written(points, links)
            }
            Kind::Force(force, share) => force.name(mechanism) + share.suffix(),
            Kind::Cycle(of) => of.name(),
        }
    }

    /// What has to be solved for this quantity. Of a force that says its loads: see
    /// [`Forces::order`](super::force::Forces::order).
    #[must_use]
    pub const fn order(&self) -> Order {
        match self.kind() {
            Kind::Motion(row) => row.order,
            Kind::Force(..) | Kind::Cycle(_) => Order::Position,
        }
    }

    /// What it measures.
    #[must_use]
    pub const fn measure(&self) -> Measure {
        match self.kind() {
            Kind::Motion(row) => row.measure,
            Kind::Force(force, _) => force.measure(),
            Kind::Cycle(of) => of.measure(),
        }
    }

    /// Of what nature its value is.
    #[must_use]
    pub const fn nature(&self) -> Nature {
        match self.kind() {
            Kind::Motion(row) => row.nature,
            Kind::Force(force, _) => force.nature(),
            Kind::Cycle(_) => Nature::Signed,
        }
    }
}

/// The kind of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Of the motion.
    Motion(Row),
    /// Of the forces, which have names of their own.
    Force(Force, Share),
    /// Of a turning-moment diagram, whose numbers have names of their own.
    Cycle(CycleQuantity),
}

/// What is the same for all quantities of motion of a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Row {
    /// A name of the kind: capital letters stand for points, digits for links.
    pub form: &'static str,
    /// What that is, in plain English.
    pub meaning: &'static str,
    /// What has to be solved for it.
    pub order: Order,
    /// What it measures.
    pub measure: Measure,
    /// Of what nature its value is.
    pub nature: Nature,
}

impl Row {
    const fn new(
        form: &'static str,
        meaning: &'static str,
        order: Order,
        measure: Measure,
        nature: Nature,
    ) -> Self {
        Self { form, meaning, order, measure, nature }
    }

    /// A vector of the velocity polygon.
    const fn velocity(form: &'static str, meaning: &'static str) -> Self {
        Self::new(form, meaning, Order::Velocity, Measure::Velocity, Nature::Vector)
    }

    /// A vector of the acceleration polygon.
    const fn acceleration(form: &'static str, meaning: &'static str) -> Self {
        Self::new(form, meaning, Order::Acceleration, Measure::Acceleration, Nature::Vector)
    }

    /// The letters before the parenthesis.
    #[must_use]
    pub fn head(&self) -> &'static str {
        self.form.split('(').next().unwrap_or_default()
    }

    /// The form with other points and links.
    fn written(
        &self,
        mut points: impl Iterator<Item = String>,
        mut links: impl Iterator<Item = String>,
    ) -> String {
        let inside = &self.form[self.head().len()..];
        let other = |letter: char| match letter {
            'A'..='Z' => points.next(),
            '0'..='9' => links.next(),
            _ => Some(letter.to_string()),
        };
        self.head().chars().map(String::from).chain(inside.chars().filter_map(other)).collect()
    }
}

/// An output unit: its symbol and how many SI units it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Unit {
    /// As written after a number (`cm/s`, `rad/s^2`, `deg`).
    pub symbol: String,
    /// SI units per unit.
    pub si: f64,
}

/// By which construction a quantity is found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Method {
    /// The velocity and the acceleration polygon; of a force the polygons of the bodies.
    #[default]
    Polygon,
    /// Instant centres, by the transfer centre of input and sought link; an acceleration polygon is fed with
    /// the velocities so found.
    Centres,
    /// Instant centres: a velocity is turned about a pole onto the line of centres, and carried over by similar
    /// triangles.
    LineOfCentres,
    /// Instant centres: from pin to pin of a chain of links, by parallels to the links.
    LinkToLink,
    /// Instant centres: from pin to pin of a chain of links, each on the gauge line of its link.
    GaugeLine,
    /// Klein's construction on the crank of a slider-crank.
    Klein,
    /// Inertia by two masses that move as the link does: their lines meet on that of the link.
    TwoMasses {
        /// Where the first mass stands, a point of the link.
        first: PointId,
        /// Where the second one stands, if that is a point of the link too: then a couple corrects their moment of
        /// inertia. Otherwise it follows from the first.
        second: Option<PointId>,
    },
    /// Zhukovsky's lever: moments of all forces about the pole of the turned velocity polygon.
    Lever,
    /// A force of a pair by three forces that meet in a point, and their triangle.
    ThreeForce,
    /// A force of a pair by moments about the pins, in parts.
    Components,
}

impl Method {
    /// The methods of which the name says everything.
    pub const PLAIN: [Self; 9] = [
        Self::Polygon,
        Self::Centres,
        Self::LineOfCentres,
        Self::LinkToLink,
        Self::GaugeLine,
        Self::Klein,
        Self::Lever,
        Self::ThreeForce,
        Self::Components,
    ];
    /// The name of the method that takes points.
    pub const TWO_MASSES: &'static str = "two-masses";

    /// The names of all methods in a scene.
    pub fn names() -> impl Iterator<Item = &'static str> {
        Self::PLAIN.into_iter().map(Self::name).chain([Self::TWO_MASSES])
    }

    /// The names of those that lead to such a quantity at all.
    pub fn names_for(quantity: &Quantity) -> impl Iterator<Item = &'static str> {
        let two_masses = Self::two_masses_answer(quantity).then_some(Self::TWO_MASSES);
        Self::PLAIN.into_iter().filter(|method| method.answers(quantity)).map(Self::name).chain(two_masses)
    }

    /// Its name in a scene.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Polygon => "polygon",
            Self::Centres => "centres",
            Self::LineOfCentres => "line-of-centres",
            Self::LinkToLink => "link-to-link",
            Self::GaugeLine => "gauge-line",
            Self::Klein => "klein",
            Self::TwoMasses { .. } => Self::TWO_MASSES,
            Self::Lever => "lever",
            Self::ThreeForce => "three-force",
            Self::Components => "components",
        }
    }

    /// Whether two masses lead to such a quantity: the inertia force of a link.
    #[must_use]
    pub fn two_masses_answer(quantity: &Quantity) -> bool {
        matches!(quantity, Quantity::Force(Force::Vector(Action::Inertia(_)), Share::Total))
    }

    /// Whether the method leads to such a quantity at all.
    #[must_use]
    pub fn answers(self, quantity: &Quantity) -> bool {
        match self {
            Self::Polygon => true,
            Self::Centres => !matches!(quantity, Quantity::Force(..) | Quantity::Cycle(_)),
            Self::TwoMasses { .. } => Self::two_masses_answer(quantity),
            Self::Lever => {
                matches!(quantity, Quantity::Force(Force::Torque(_) | Force::Drive(_), Share::Total))
            }
            Self::ThreeForce | Self::Components => match quantity {
                Quantity::Force(force, Share::Total) => force.pair().is_some(),
                _ => false,
            },
            Self::LineOfCentres | Self::LinkToLink | Self::GaugeLine => {
                matches!(quantity, Quantity::Velocity(_) | Quantity::Omega(_))
            }
            Self::Klein => matches!(
                quantity,
                Quantity::Velocity(_)
                    | Quantity::RelativeVelocity(..)
                    | Quantity::Acceleration(_)
                    | Quantity::RelativeAcceleration(..)
                    | Quantity::Omega(_)
                    | Quantity::Alpha(_)
            ),
        }
    }
}

/// One asked quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Asked {
    /// As the scene wrote it; echoed in every output.
    pub name: String,
    /// What it means.
    pub quantity: Quantity,
    /// In which unit it is answered.
    pub unit: Unit,
    /// By which construction.
    pub method: Method,
}

impl Asked {
    /// Whether it is a velocity that is asked for by a method of instant centres.
    #[must_use]
    pub fn by_centres(&self) -> bool {
        let centres = matches!(
            self.method,
            Method::Centres | Method::LineOfCentres | Method::LinkToLink | Method::GaugeLine
        );
        centres && self.quantity.order() == Order::Velocity && !matches!(self.quantity, Quantity::Centre(..))
    }

    /// Whether it is an acceleration whose polygon is fed with velocities from instant centres.
    #[must_use]
    pub fn fed_by_centres(&self) -> bool {
        self.method == Method::Centres && self.quantity.order() == Order::Acceleration
    }
}

/// How friction leaves forces without a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stuck {
    /// A pair that rubs does not move: its friction has no sense.
    AtRest,
    /// No balance exists.
    Locked,
    /// Two balances fit.
    Ambiguous,
}

/// Why a quantity is not determined here.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Indeterminate {
    /// Two construction lines, or a link pair, are in line or parallel at this instant.
    DeadCentre {
        /// Numbers of the links that are in line, ascending; empty where it cannot be named.
        links: Vec<u32>,
    },
    /// The mechanism's Jacobian is singular here (analytic solver).
    Singular,
    /// So close to a dead centre, or to a change point, that rounding leaves none of its first digits certain.
    Unclear,
    /// Within the rooms in which places are known there may be a dead centre, and where they are stated is none.
    Room {
        /// Names of the points that were stated with a room.
        points: Vec<String>,
    },
    /// Friction leaves no value here, or more than one.
    Rubbing {
        /// In which way.
        how: Stuck,
        /// In plain English, one clause.
        why: String,
    },
    /// No equilibrium is possible: a contact would have to pull, a speed to be imaginary.
    NoEquilibrium {
        /// In plain English, one clause.
        why: String,
    },
    /// The asked direction does not exist (a centre of two links that do not move against each other).
    Undefined {
        /// In plain English, one clause.
        why: String,
    },
}

impl fmt::Display for Indeterminate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DeadCentre { links } if links.is_empty() => {
                write!(f, "dead centre: construction lines are parallel")
            }
            Self::DeadCentre { links } => {
                let names: Vec<String> = links.iter().map(u32::to_string).collect();
                match names.split_last() {
                    Some((last, rest)) if !rest.is_empty() => {
                        write!(f, "dead centre: links {} and {last} in line", rest.join(", "))
                    }
                    _ => write!(f, "dead centre at link {}", names.join("")),
                }
            }
            Self::Singular => write!(f, "dead centre: the motion is not determined by the input here"),
            Self::Unclear => {
                write!(f, "too close to a dead centre: rounding leaves not three digits of it certain")
            }
            Self::Room { points } => {
                write!(f, "the room that is stated for {} leaves it open", points.join(" and "))
            }
            Self::Rubbing { why, .. } | Self::Undefined { why } | Self::NoEquilibrium { why } => {
                write!(f, "{why}")
            }
        }
    }
}

/// A solver's answer in SI units, with its bound.
#[derive(Debug, Clone, PartialEq)]
pub enum Answer {
    /// A signed scalar.
    Scalar {
        /// SI value, ccw positive.
        value: f64,
        /// |value − truth| ≤ bound.
        bound: f64,
    },
    /// A vector or a place.
    Vector {
        /// SI components, x right, y up.
        value: [f64; 2],
        /// |value − truth| (length of the difference) ≤ bound.
        bound: f64,
    },
    /// A centre at infinity.
    AtInfinity {
        /// Unit vector of the direction; its sign has no meaning.
        direction: [f64; 2],
        /// Radius of uncertainty of the direction, radians.
        bound: f64,
    },
    /// Not determined at this position.
    Indeterminate(Indeterminate),
}

impl Answer {
    /// Whether the bound allows that it is zero: then it has no sense, no direction, and no digits.
    #[must_use]
    pub fn may_be_zero(&self) -> bool {
        match self {
            Self::Scalar { value, bound } => value.abs() <= *bound,
            Self::Vector { value: [x, y], bound } => libm::hypot(*x, *y) <= *bound,
            Self::AtInfinity { .. } | Self::Indeterminate(_) => false,
        }
    }
}
