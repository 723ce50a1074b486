//! What a construction asks for and no step has drawn.
//!
//! A place that does not stand is not a point, and a rate that nobody has read is not zero. Who asks for one gets
//! ink that leads nowhere: whatever is read from it is refused, with the reason told here. A skeleton in which
//! something was missing is refused as a whole ([`super::DrawError::Missing`]).

use crate::board::{Amount, Direction, Point, Reason};
use crate::mechanism::force::{Sought, Unaimed};
use crate::mechanism::friction::RubbingPair;
use crate::mechanism::quantity::{Indeterminate, Order, Stuck};
use crate::mechanism::structure::TrialDriver;
use crate::mechanism::{LinkId, Mechanism, PointId};

use super::DrawError;
use super::draughtsman::Draughtsman;

/// What is missing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Missing {
    /// The place of a point.
    Place(PointId),
    /// A point of the own figure of a link.
    OwnPoint(LinkId, PointId),
    /// How a link stands.
    Pose(LinkId),
    /// A joint of a link that has none, or too few.
    Joint(LinkId),
    /// A straight guide of a link, where it has an arc.
    StraightGuide(LinkId),
    /// The angle, or the place, that an input gives.
    Input(usize),
    /// The image of a point in a polygon.
    Image(Order, PointId),
    /// The angular velocity or acceleration of a link.
    Rate(Order, LinkId),
    /// How fast a rider slides, or how its sliding changes; by index of the pair.
    Sliding(usize),
    /// The size of a load or spring that is sought.
    Sought,
    /// Work: what is sought does none, and no size of it balances anything.
    Work(Sought),
    /// In which sense a pair that rubs moves.
    Sense(RubbingPair),
    /// On which side of it a rough guide presses.
    Side(RubbingPair),
    /// A balance with friction: forces drawn again and again come to no end.
    Balance,
    /// The direction of a load or spring.
    Aim(Unaimed),
    /// The turning of a link, of which another one's is a multiple.
    Turning(LinkId),
}

impl Missing {
    /// The rate of a trial driver.
    pub(super) fn rate_of(order: Order, driver: TrialDriver) -> Self {
        match driver {
            TrialDriver::Turn(link) => Self::Rate(order, link),
            TrialDriver::Slide(slide) => Self::Sliding(slide),
        }
    }

    /// Why what hangs on it is not determined.
    pub(super) fn indeterminate(&self, mechanism: &Mechanism) -> Indeterminate {
        let why = self.say(mechanism);
        match self {
            Self::Sense(_) | Self::Side(_) => Indeterminate::Rubbing { how: Stuck::AtRest, why },
            Self::Balance => Indeterminate::Rubbing { how: Stuck::Locked, why },
            _ => Indeterminate::Undefined { why },
        }
    }

    /// What is missing, as a clause in plain English.
    #[must_use]
    pub fn say(&self, mechanism: &Mechanism) -> String {
        let name = |point: PointId| &mechanism.point(point).name;
        let number = |link: LinkId| mechanism.link(link).number;
        let word = |order: Order| match order {
            Order::Position => "place",
            Order::Velocity => "velocity",
            Order::Acceleration => "acceleration",
        };
        match *self {
            Self::Place(point) => format!("no step of the drawing finds the place of {}", name(point)),
            Self::OwnPoint(link, point) => {
                format!("link {} does not say where its point {} is", number(link), name(point))
            }
            Self::Pose(link) => format!("no step of the drawing finds how link {} stands", number(link)),
            Self::Joint(link) => format!("link {} has too few joints for this construction", number(link)),
            Self::StraightGuide(link) => {
                format!("this construction needs a straight guide on link {}, not an arc", number(link))
            }
            Self::Image(order, point) => {
                format!("no step of the drawing finds the {} of {}", word(order), name(point))
            }
            Self::Sliding(slide) => {
                let guide = mechanism.slides[slide].guide.link;
                format!("no step of the drawing finds how its rider slides on link {}", number(guide))
            }
            Self::Rate(order, link) => {
                format!("no step of the drawing finds the angular {} of link {}", word(order), number(link))
            }
            Self::Input(input) => format!("input {} gives no value to draw with", input + 1),
            Self::Turning(link) => format!("ω{} is zero", number(link)),
            Self::Aim(what) => mechanism.say_unaimed(what),
            Self::Sense(pair) => {
                format!("{} does not move: its friction has no sense", mechanism.say_rubbing(pair))
            }
            Self::Side(pair) => {
                format!("nothing presses on {}: its friction has no side", mechanism.say_rubbing(pair))
            }
            Self::Balance => {
                "locked: drawn again with friction, the forces come to no end: no balance exists".to_owned()
            }
            Self::Work(sought) => mechanism.say_idle(sought),
            Self::Sought => "no step of the drawing finds the size of a load that is sought".to_owned(),
        }
    }
}

impl Draughtsman<'_> {
    /// Notes that something is missing, and gives the reason for whatever is drawn from it.
    pub(super) fn miss_of(&mut self, what: Missing) -> Reason {
        self.missing.get_or_insert(what);
        self.reason_missing(what)
    }

    /// In the place of a point that is missing: nowhere.
    pub(super) fn no_point(&mut self, what: Missing) -> Point {
        let reason = self.miss_of(what);
        self.board.nowhere(reason)
    }

    /// In the place of a direction that is missing: no direction.
    pub(super) fn no_direction(&mut self, what: Missing) -> Direction {
        let reason = self.miss_of(what);
        self.board.no_direction(reason)
    }

    /// In the place of an amount that no step has found: unknown.
    pub(super) fn no_amount(&mut self, what: Missing) -> Amount {
        let reason = self.miss_of(what);
        self.board.unknown(reason)
    }

    /// A skeleton, or a part of it, stands on nothing that is missing.
    ///
    /// # Errors
    /// [`DrawError::Missing`] with the first thing that was asked for and is not there.
    pub(super) fn nothing_missing(&mut self) -> Result<(), DrawError> {
        match self.missing.take() {
            Some(what) => Err(DrawError::Missing(what)),
            None => Ok(()),
        }
    }
}
