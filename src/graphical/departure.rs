//! How somebody's drawing departs from the right one, and what becomes of it: every later step is drawn as
//! always, from what stands on the paper.
//!
//! A [`Departure`] says *which* line, length or reading is another than it should be; it does not say why. The
//! names of mistakes are given in `grade/`.

use crate::board::{Amount, Board, Direction, Hand, Line, Mm, Point, Tape};
use crate::given::Given;
use crate::mechanism::force::{Action, Share};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::Plan;

use super::construction::{Act, Calculation, Claim, Construction, ForceSheet, Mm2};
use super::draughtsman::Draughtsman;
use super::dyad::Route;
use super::reading::read_all;
use super::trial::Searched;
use super::{DrawError, Scales, draw_departing};

/// One way in which a drawing departs from the right one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Departure {
    /// A vector of known length and direction is laid off otherwise.
    LaidOff {
        /// The vector.
        quantity: Quantity,
        /// How.
        twist: Twist,
    },
    /// A line of unknown length is drawn square to its right direction.
    Ray {
        /// In which polygon.
        order: Order,
        /// The direction that it should have.
        claim: Claim,
    },
    /// What is read of a vector is multiplied before anything is calculated from it.
    Read {
        /// The vector.
        quantity: Quantity,
        /// −1 turns its sense.
        factor: f64,
    },
    /// The same for every vector that is read off a polygon.
    ReadAll {
        /// The polygon.
        order: Order,
        /// By what its readings are multiplied.
        factor: f64,
    },
    /// A calculated ω or ε is multiplied.
    Rate {
        /// [`Order::Velocity`] for ω, [`Order::Acceleration`] for ε.
        order: Order,
        /// The link.
        link: LinkId,
        /// −1 turns its sense.
        factor: f64,
    },
    /// ω or ε of a link has another value, SI, ccw positive.
    RateIs {
        /// [`Order::Velocity`] for ω, [`Order::Acceleration`] for ε.
        order: Order,
        /// The link.
        link: LinkId,
        /// The value.
        value: f64,
    },
    /// The image of a point stands elsewhere.
    Image {
        /// In which polygon.
        order: Order,
        /// The point.
        point: PointId,
        /// Where, millimetres from the pole.
        at: Mm2,
    },
    /// The image of the point of a link under a pin of another stands elsewhere.
    Under {
        /// In which polygon.
        order: Order,
        /// The pin.
        pin: PointId,
        /// The link.
        link: LinkId,
        /// Where, millimetres from the pole.
        at: Mm2,
    },
    /// The image of a point lies on the wrong side of the image of a line of its link.
    Mirrored {
        /// In which polygon.
        order: Order,
        /// The point.
        point: PointId,
        /// The line.
        about: [PointId; 2],
    },
    /// The image of a point is laid off backwards from the image of another point of its link.
    Backwards {
        /// In which polygon.
        order: Order,
        /// The point.
        point: PointId,
        /// The other point.
        from: PointId,
    },
    /// Of two intersections on the skeleton the other one is taken for this pin.
    OtherSide(PointId),
    /// Of two ways in which a link can stand the other one is taken.
    OtherPose(LinkId),
    /// The inertia force of a link, of every link where none is named, is laid off otherwise.
    InertiaForce {
        /// The link.
        link: Option<LinkId>,
        /// How.
        twist: Twist,
    },
    /// −I ε of a link, of every link where none is named, is multiplied.
    InertiaTorque {
        /// The link.
        link: Option<LinkId>,
        /// By this.
        factor: f64,
    },
    /// The distance at which an inertia force passes its mass centre is multiplied; −1 puts it on the other side.
    Offset {
        /// The link; every link where none is named.
        link: Option<LinkId>,
        /// By this.
        factor: f64,
    },
    /// The weight of a link, of every link where none is named, is multiplied.
    Weight {
        /// The link.
        link: Option<LinkId>,
        /// By this.
        factor: f64,
    },
    /// Something acts on a link besides what does: a force at a place, metres from the skeleton's origin, and a couple.
    Beside {
        /// The link.
        link: LinkId,
        /// Newtons.
        force: [f64; 2],
        /// Where.
        at: [f64; 2],
        /// N m, ccw positive.
        couple: f64,
    },
    /// The force of a guide is drawn along another direction than square to it.
    GuideForce {
        /// Index of the sliding pair.
        slide: usize,
        /// The direction, radians from +x.
        along: f64,
    },
    /// The radius of a friction circle is multiplied; −1 takes the tangent on its other side.
    FrictionCircle {
        /// The pin.
        pin: PointId,
        /// By this.
        factor: f64,
    },
    /// The tangent of the angle of friction in a guide is multiplied; −1 leans the force the other way.
    FrictionAngle {
        /// Index of the sliding pair.
        slide: usize,
        /// By this.
        factor: f64,
    },
    /// Of all that acts only this part is laid off.
    OnlyShare(Share),
    /// A force of a pair is another one from where it is found on, newtons.
    ForceIs {
        /// Which.
        action: Action,
        /// Its components.
        force: [f64; 2],
    },
}

/// What becomes of a vector that is laid off wrongly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Its length times this; −1 turns its sense, 0 leaves it out.
    pub factor: f64,
    /// Its direction turned by this, radians, ccw positive.
    pub turn: f64,
}

impl Twist {
    /// The length times a factor, in the same direction.
    #[must_use]
    pub fn scaled(factor: f64) -> Self {
        Self { factor, turn: 0.0 }
    }
}

/// What stands on the paper of a drawing that departs from the right one.
#[derive(Debug, Clone)]
pub struct Sketch {
    /// The asked quantities as read off, SI: two numbers for a vector, one for a scalar, `None` for what has
    /// none. A centre at infinity has one number, its direction in radians.
    pub numbers: Vec<Option<Vec<f64>>>,
    /// A point of the line of each asked force, metres in the world; none of what has none.
    pub lines: Vec<Option<[f64; 2]>>,
    /// Skeleton and polygons; its answers are empty.
    pub construction: Construction,
}

/// Draws a mechanism with departures from the right construction; by an exact hand, or by a draughtsman with
/// dice (his hand, his number). What an exact hand finds by trial is kept for the next drawing.
///
/// # Errors
/// As [`super::construct`]: a departure may part what would meet.
pub fn sketch(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
    (departures, searched): (&[Departure], &Searched),
    draughtsman: Option<(Hand, u64)>,
) -> Result<Sketch, DrawError> {
    if let Some((hand, seed)) = draughtsman {
        let board = Board::new(Tape::trembling(hand, seed));
        return draw_departing(board, mechanism, structure, plan, scales, (departures, None)).map(finish);
    }
    let manner = (departures, Some(searched));
    let bare = || {
        let board = Board::scratch();
        draw_departing(board, mechanism, structure, plan, scales, manner).map(finish)
    };
    // Only a tape tells a tangency from a miss.
    let taped = || {
        let board = Board::default();
        draw_departing(board, mechanism, structure, plan, scales, manner).map(finish)
    };
    bare().or_else(|_| taped())
}

/// The free bodies of a drawing with departures, by an exact hand; none where nothing is balanced.
///
/// # Errors
/// As [`sketch`].
pub fn free_bodies(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
    departures: &[Departure],
) -> Result<Option<ForceSheet>, DrawError> {
    let mut drawn = draw_departing(Board::default(), mechanism, structure, plan, scales, (departures, None))?;
    Ok(super::forces::record(&mut drawn, plan))
}

fn finish(mut d: Draughtsman<'_>) -> Sketch {
    let read = read_all(&mut d);
    let lines = read.iter().map(|read| read.through).collect();
    let numbers = read
        .into_iter()
        .map(|read| {
            let numbers: Vec<f64> = read.numbers.ok()?.into_iter().map(|(_, value)| value).collect();
            numbers.iter().all(|n| n.is_finite()).then_some(numbers)
        })
        .collect();
    Sketch { numbers, lines, construction: d.into_record() }
}

/// An image counts as on a line if it is off it by less than this part of its distance.
const ON_THE_LINE: f64 = 1e-6;

impl Draughtsman<'_> {
    /// Lays off a vector of known length.
    pub(super) fn lay_off_vector(
        &mut self,
        quantity: Quantity,
        from: Point,
        along: Direction,
        mm: Mm,
    ) -> Point {
        let twists = self.departures.iter().filter_map(|departure| match *departure {
            Departure::LaidOff { quantity: of, twist } if of == quantity => Some(twist),
            _ => None,
        });
        let Some(twist) = twists.reduce(|a, b| Twist { factor: a.factor * b.factor, turn: a.turn + b.turn })
        else {
            return self.board.lay_off(from, along, mm);
        };
        let turn = self.board.angle(Given::exact(twist.turn));
        let along = self.board.turned(along, turn);
        let mm = self.board.multiple(mm, twist.factor);
        self.board.lay_off(from, along, mm)
    }

    /// A route as it is drawn.
    pub(super) fn ray_as_drawn(&mut self, order: Order, route: Route) -> Route {
        let turned = self.departures.contains(&Departure::Ray { order, claim: route.claim });
        if !turned {
            return route;
        }
        let along = self.board.quarter_turn(route.ray.along);
        Route { ray: Line { through: route.ray.through, along }, ..route }
    }

    /// The length to be read along a route to an image: signed by the route where the image lies on it, or, where
    /// somebody's lines have another direction than he thinks, the distance, positive.
    pub(super) fn length_along(&mut self, route: &Route, at: Point, meet: Mm) -> Mm {
        let [along, across] = self.board.square_off(route.ray, at);
        if across.value().abs() <= ON_THE_LINE * along.value().abs() {
            return along;
        }
        let distance = self.board.distance(route.foot.1, at);
        self.board.multiple(distance, if meet.value() < 0.0 { -1.0 } else { 1.0 })
    }

    /// A vector as it is read. What was calculated is written down, and not read off with all others.
    pub(super) fn as_read(&mut self, quantity: Quantity, amount: Amount) -> Amount {
        let order = quantity.order();
        let calculated = self.is_calculated(quantity);
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::Read { quantity: of, factor } if of == quantity => Some(factor),
            Departure::ReadAll { order: of, factor } if of == order && !calculated => Some(factor),
            _ => None,
        });
        let factor = factors.reduce(|a, b| a * b);
        self.multiplied(amount, factor)
    }

    /// Whether a vector was calculated by the rate of its link before it was laid off.
    fn is_calculated(&self, quantity: Quantity) -> bool {
        let own = |act: &Act| match *act {
            Act::Calculate(
                Calculation::Speed { quantity: of, .. } | Calculation::Tangential { quantity: of, .. },
            ) => of == quantity,
            _ => false,
        };
        !self.departures.is_empty() && self.record().steps.iter().flat_map(|step| &step.acts).any(own)
    }

    /// The speed from which a normal part is calculated: as read, but for a driven link, where it was calculated
    /// before.
    pub(super) fn speed_as_read(&mut self, link: LinkId, velocity: Quantity, amount: Amount) -> Amount {
        let driven = self.mechanism.inputs.iter().any(|input| match *input {
            Input::Angle { link: of, .. } | Input::Speed { link: of, .. } => of == link,
            Input::Slide { .. } => false,
        });
        if driven { amount } else { self.as_read(velocity, amount) }
    }

    /// ω or ε as it is calculated.
    pub(super) fn rate_as_calculated(&mut self, order: Order, link: LinkId, amount: Amount) -> Amount {
        let stated = self.departures.iter().rev().find_map(|departure| match *departure {
            Departure::RateIs { order: o, link: of, value } if (o, of) == (order, link) => Some(value),
            _ => None,
        });
        if let Some(value) = stated {
            return self.board.amount(Given::exact(value));
        }
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::Rate { order: o, link: of, factor } if (o, of) == (order, link) => Some(factor),
            _ => None,
        });
        let factor = factors.reduce(|a, b| a * b);
        self.multiplied(amount, factor)
    }

    fn multiplied(&mut self, amount: Amount, factor: Option<f64>) -> Amount {
        match factor {
            Some(factor) => {
                let factor = self.board.amount(Given::exact(factor));
                self.board.product(amount, factor)
            }
            None => amount,
        }
    }

    /// The image of a point as it stands on the paper.
    pub(super) fn image_as_drawn(&mut self, order: Order, point: PointId, at: Point) -> Point {
        let mut at = at;
        for index in 0..self.departures.len() {
            match self.departures[index] {
                Departure::Image { order: o, point: of, at: there } if (o, of) == (order, point) => {
                    at = self.board.copied(there);
                }
                Departure::Mirrored { order: o, point: of, about } if (o, of) == (order, point) => {
                    at = self.mirrored(order, about, at);
                }
                Departure::Backwards { order: o, point: of, from } if (o, of) == (order, point) => {
                    at = self.backwards(order, from, at);
                }
                _ => {}
            }
        }
        at
    }

    /// The image of the point of a link under a pin as it stands on the paper.
    pub(super) fn under_as_drawn(&mut self, order: Order, pin: PointId, link: LinkId, at: Point) -> Point {
        let stated = self.departures.iter().rev().find_map(|departure| match *departure {
            Departure::Under { order: o, pin: of, link: on, at } if (o, of, on) == (order, pin, link) => {
                Some(at)
            }
            _ => None,
        });
        stated.map_or(at, |there| self.board.copied(there))
    }

    /// Whether a point has an image yet.
    fn has_image(&mut self, order: Order, point: PointId) -> bool {
        self.mechanism.is_fixed(point) || self.images(order)[point.0].is_some()
    }

    /// A point as far behind the image of another one; where that has no image yet, the point itself.
    fn backwards(&mut self, order: Order, from: PointId, at: Point) -> Point {
        if !self.has_image(order, from) {
            return at;
        }
        let from = self.image(order, from);
        let reason = self.reason(&[]);
        let (along, length) = self.board.toward(from, at, reason);
        if self.board.is_nothing(length) {
            return at;
        }
        let back = self.board.reverse(along);
        self.board.lay_off(from, back, length)
    }

    /// A point on the other side of the image of a line; where that has no image yet, the point itself.
    fn mirrored(&mut self, order: Order, about: [PointId; 2], at: Point) -> Point {
        if !about.iter().all(|&p| self.has_image(order, p)) {
            return at;
        }
        let [from, to] = about.map(|p| self.image(order, p));
        let reason = self.reason(&[]);
        let (along, length) = self.board.toward(from, to, reason);
        if self.board.is_nothing(length) {
            return at;
        }
        let [forward, left] = self.board.square_off(Line { through: from, along }, at);
        let foot = self.board.step_off(from, along, forward);
        let square = self.board.quarter_turn(along);
        let right = self.board.reverse(square);
        self.board.step_off(foot, right, left)
    }

    /// Whether the other intersection is taken for a pin.
    pub(super) fn takes_other_side(&self, pin: PointId) -> bool {
        self.departures.contains(&Departure::OtherSide(pin))
    }

    /// Whether a link stands in the other of two ways.
    pub(super) fn takes_other_pose(&self, link: LinkId) -> bool {
        self.departures.contains(&Departure::OtherPose(link))
    }
}
