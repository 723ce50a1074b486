//! The turning-moment diagram: torque and load over the angle of the input, the inertia that turns with it, and what may
//! be asked of them. Numbers stand as they were given.

use super::curve::Curve;
use super::quantity::Measure;
use super::{Given, Input, LinkId, Mechanism};

/// A turning-moment diagram.
#[derive(Debug, Clone, PartialEq)]
pub struct Cycle {
    /// What is known of the two torques.
    pub sides: Sides,
    /// After which angle everything comes again, radians, positive.
    pub period: Given,
    /// The same curves again, shifted.
    pub copies: Copies,
    /// Known inertias that turn with the input.
    pub rotating: Vec<Rotating>,
    /// The wanted coefficient of fluctuation of speed, (ω_max − ω_min)/ω; then a flywheel is sought.
    pub fluctuation: Option<Given>,
    /// Mean speed of the input, rad/s, ccw positive.
    pub omega: Given,
    /// The angle of the input falls as time goes on: a mechanism's input that turns clockwise. The diagram then begins at
    /// angle 0 and runs down from there, as its mirror image runs up: crossings, areas and levels stand in the order and
    /// with the signs of the motion. Never of a diagram without a mechanism, whose angle is what has been turned.
    pub falling: bool,
}

/// The driving and the resisting torque, both referred to the first input and ccw positive in the sense in which they
/// drive and are driven. One that is missing is constant, the mean of the other.
#[derive(Debug, Clone, PartialEq)]
pub enum Sides {
    /// Only what drives is known.
    Torque(Course),
    /// Only what resists is known.
    Load(Course),
    /// Both are.
    Both {
        /// What drives.
        torque: Course,
        /// What resists.
        load: Course,
    },
    /// Areas between the driving torque and its mean, as a planimeter gives them.
    Areas {
        /// From the first crossing on, above the mean positive: areas of the paper.
        areas: Vec<Given>,
        /// N m for a unit of length of the paper.
        torque: Given,
        /// Radians for a unit of length of the paper.
        angle: Given,
        /// The whole area under the curve, of the paper: for the mean and what hangs on it.
        total: Option<Given>,
    },
}

/// A torque over the angle of the input.
#[derive(Debug, Clone, PartialEq)]
pub enum Course {
    /// What the mechanism gives, or as a load needs, at its driven link.
    Of(LinkId),
    /// A curve.
    Curve(Curve),
}

/// How often the same curves are added, each shifted against the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Copies {
    /// How many there are in all, at least one.
    pub number: u32,
    /// By which angle each follows the one before in the sense of the motion, radians.
    pub shift: Given,
}

/// An inertia that turns with the input, at a speed in a fixed ratio to its speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rotating {
    /// How it is given.
    pub inertia: RotatingInertia,
    /// Its speed over that of the input.
    pub ratio: Given,
}

/// A moment of inertia as a scene states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RotatingInertia {
    /// kg m².
    Central(Given),
    /// A mass (kg) with its radius of gyration (m).
    Mass(Given, Given),
    /// A weight (N) with its radius of gyration (m).
    Weight(Given, Given),
}

/// What may be asked of a turning-moment diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum CycleQuantity {
    /// `Tmean`: the mean of the driving torque, N m.
    Mean,
    /// `E`: its work in a period, J.
    Work,
    /// `power`: mean torque times mean speed, W.
    Power,
    /// `Emax`: the highest level of energy, from angle 0 in the sense of the motion, J.
    Highest,
    /// `Emin`: the lowest level, J.
    Lowest,
    /// `Ef`: their difference, J.
    Fluctuation,
    /// `Ke`: that over the work of a period.
    OfEnergy,
    /// `Ks`: Ef/(I ω²).
    OfSpeed,
    /// `If`: the flywheel that is still needed at the input, kg m².
    Flywheel,
    /// `I`: what turns already, referred to the input, kg m².
    Inertia,
    /// `crossing(k)`: angle of the k-th crossing from 0 in the sense of the motion, rad.
    Crossing(u32),
    /// `area(k)`: work from crossing k to the next, J.
    Area(u32),
    /// `level(k)`: level at crossing k, with areas after area k, J.
    Level(u32),
    /// `angle(Emax)`, rad.
    AtHighest,
    /// `angle(Emin)`, rad.
    AtLowest,
    /// `alpha(max)`: the greatest angular acceleration, rad/s².
    Most,
    /// `alpha(min)`: the least, rad/s².
    Least,
    /// `angle(alpha_max)`: where it is, rad.
    AtMost,
    /// `angle(alpha_min)`, rad.
    AtLeast,
}

impl CycleQuantity {
    /// What it measures.
    #[must_use]
    pub const fn measure(self) -> Measure {
        match self {
            Self::Mean
            | Self::Work
            | Self::Highest
            | Self::Lowest
            | Self::Fluctuation
            | Self::Area(_)
            | Self::Level(_) => Measure::Torque,
            Self::Power => Measure::Power,
            Self::OfEnergy | Self::OfSpeed => Measure::Number,
            Self::Flywheel | Self::Inertia => Measure::Inertia,
            Self::Crossing(_) | Self::AtHighest | Self::AtLowest | Self::AtMost | Self::AtLeast => {
                Measure::Angle
            }
            Self::Most | Self::Least => Measure::AngularAcceleration,
        }
    }

    /// Whether it hangs on the order of the crossings from the beginning of the period.
    #[must_use]
    pub fn counts_crossings(self) -> bool {
        matches!(self, Self::Crossing(_) | Self::Area(_) | Self::Level(_) | Self::AtHighest | Self::AtLowest)
    }

    /// The other numbers of the diagram from which it is computed.
    #[must_use]
    pub const fn computed_from(self) -> &'static [Self] {
        match self {
            Self::Mean => &[Self::Work],
            Self::Power => &[Self::Mean, Self::Work],
            Self::Fluctuation => &[Self::Highest, Self::Lowest],
            Self::OfEnergy => &[Self::Fluctuation, Self::Highest, Self::Lowest, Self::Work],
            Self::Flywheel => &[Self::Fluctuation, Self::Highest, Self::Lowest, Self::Inertia],
            // Where a fluctuation is wanted the flywheel that is still needed turns as well.
            Self::OfSpeed => &[Self::Fluctuation, Self::Highest, Self::Lowest, Self::Inertia, Self::Flywheel],
            Self::Most => &[
                Self::AtMost,
                Self::Mean,
                Self::Work,
                Self::Inertia,
                Self::Flywheel,
                Self::Fluctuation,
                Self::Highest,
                Self::Lowest,
            ],
            Self::Least => &[
                Self::AtLeast,
                Self::Mean,
                Self::Work,
                Self::Inertia,
                Self::Flywheel,
                Self::Fluctuation,
                Self::Highest,
                Self::Lowest,
            ],
            _ => &[],
        }
    }

    /// Whether areas between a curve and its mean tell it only with the whole area under the curve.
    #[must_use]
    pub fn hangs_on_mean(self) -> bool {
        matches!(self, Self::Mean | Self::Work | Self::Power | Self::OfEnergy)
    }

    /// Whether it is an energy: a torque's unit is that of a work.
    #[must_use]
    pub fn is_energy(self) -> bool {
        self.measure() == Measure::Torque && self != Self::Mean
    }

    /// As a scene names it.
    #[must_use]
    pub fn name(self) -> String {
        let plain = match self {
            Self::Crossing(k) => return format!("crossing({k})"),
            Self::Area(k) => return format!("area({k})"),
            Self::Level(k) => return format!("level({k})"),
            Self::Mean => "Tmean",
            Self::Work => "E",
            Self::Power => "power",
            Self::Highest => "Emax",
            Self::Lowest => "Emin",
            Self::Fluctuation => "Ef",
            Self::OfEnergy => "Ke",
            Self::OfSpeed => "Ks",
            Self::Flywheel => "If",
            Self::Inertia => "I",
            Self::AtHighest => "angle(Emax)",
            Self::AtLowest => "angle(Emin)",
            Self::Most => "alpha(max)",
            Self::Least => "alpha(min)",
            Self::AtMost => "angle(alpha_max)",
            Self::AtLeast => "angle(alpha_min)",
        };
        plain.to_owned()
    }

    /// Whether it is of the place where the torques differ most.
    #[must_use]
    pub fn is_of_steepest(self) -> bool {
        matches!(self, Self::Most | Self::Least | Self::AtMost | Self::AtLeast)
    }

    /// Whether it is an angle of the input.
    #[must_use]
    pub fn is_angle(self) -> bool {
        matches!(self, Self::Crossing(_) | Self::AtHighest | Self::AtLowest | Self::AtMost | Self::AtLeast)
    }
}

/// How often a curve, or each of its waves, comes again in a turn.
fn times_in_a_turn(curve: &Curve) -> Vec<f64> {
    match curve {
        Curve::Table { period, .. } => vec![std::f64::consts::TAU / period.value],
        Curve::Harmonics { sin, cos, .. } => sin.iter().chain(cos).map(|wave| wave.order.value).collect(),
    }
}

/// A mechanism comes round with the curves of its loads after no more turns than these.
const MOST_TURNS: u32 = 100;

impl Mechanism {
    /// After how many turns of its first input the mechanism stands as it did, with its loads as they were: one, where no
    /// load has a curve. None where that is never, or nobody waits for it.
    #[must_use]
    pub fn turns_of_loads(&self) -> Option<u32> {
        let times: Vec<f64> = self.forces.curves.iter().flat_map(times_in_a_turn).collect();
        let whole = |turns: u32, times: f64| {
            let all = f64::from(turns) * times;
            (all - all.round()).abs() < 1e-9 * all
        };
        (1..=MOST_TURNS).find(|turns| times.iter().all(|times| whole(*turns, *times)))
    }

    /// Every input keeps its speed.
    pub fn run_steadily(&mut self) {
        for input in &mut self.inputs {
            match input {
                Input::Angle { alpha: change, .. }
                | Input::Speed { alpha: change, .. }
                | Input::Slide { acceleration: change, .. } => *change = Given::exact(0.0),
            }
        }
    }
}

impl Cycle {
    /// Whether the mean torque is known: areas alone do not tell it.
    #[must_use]
    pub fn has_mean(&self) -> bool {
        !matches!(self.sides, Sides::Areas { total: None, .. })
    }

    /// The courses of the mechanism among the two torques.
    #[must_use]
    pub fn of(&self) -> Option<LinkId> {
        let of = |course: &Course| match course {
            Course::Of(link) => Some(*link),
            Course::Curve(_) => None,
        };
        match &self.sides {
            Sides::Torque(course) | Sides::Load(course) => of(course),
            Sides::Both { torque, load } => of(torque).or(of(load)),
            Sides::Areas { .. } => None,
        }
    }
}
