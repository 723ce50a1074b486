//! The constraint equations of all pairs, each written once as a function of time.
//!
//! An equation `F(q, t) = 0` in the body coordinates `q = (x, y, θ)` of the bodies it binds is evaluated
//! as a jet: its value, and its first and second derivative along the motion `q, q̇, q̈`. The record
//! ([`super::tape`]) then yields the Jacobian row, the right-hand side of the acceleration equation
//! (−J̇ q̇), the sensitivities to every given number and the rounding bound, without a second formula
//! that could disagree. Body coordinates and constraint forms follow Haug, *Computer Aided Kinematics
//! and Dynamics of Mechanical Systems* (1989), chapter 3.

use super::tape::{Calculus, Jet, Leaf, Linear, Tape, Vector, dot, minus, plus, quarter, turned};

/// A number of the model: exact, or a parameter with an error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Num {
    /// Exact.
    Exact(f64),
    /// Index into the table of parameters.
    Param(usize),
}

/// A parameter in the scaled units of the model.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Param {
    /// Its value.
    pub(super) value: f64,
    /// Its radius of uncertainty.
    pub(super) error: f64,
}

/// A point of a body, in the body's own coordinates. Body 0 is the frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Site {
    /// The body.
    pub(super) body: usize,
    /// Own coordinates.
    pub(super) own: [Num; 2],
}

/// Direction of a straight guide in the body's own coordinates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Bearing {
    /// Angle from the own x-axis.
    Angle(Num),
    /// Towards a point of the body.
    Toward([Num; 2]),
}

/// A straight guide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Straight {
    /// The body that carries it, and a point of the line before the offset.
    pub(super) through: Site,
    /// Its direction before `turned`.
    pub(super) bearing: Bearing,
    /// Added to the direction.
    pub(super) turned: Num,
    /// Shift to the left.
    pub(super) offset: Num,
}

/// An arc guide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Arc {
    /// The body that carries it, and the centre of curvature.
    pub(super) centre: Site,
    /// Radius.
    pub(super) radius: Num,
}

/// A driving function of time: value, rate and second rate at this instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Drive {
    /// Value.
    pub(super) value: Num,
    /// First derivative, to be divided by the distance of the two points of `arm`.
    pub(super) rate: Num,
    /// The arm at whose end the rate is a speed; `None` where the rate is meant itself.
    pub(super) arm: Option<[[Num; 2]; 2]>,
    /// Second derivative.
    pub(super) second: Num,
}

/// One scalar equation.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Row {
    /// Two points have the same coordinate `axis`.
    Coincide(Site, Site, usize),
    /// A point lies on a straight guide.
    OnLine(Site, Straight),
    /// A point lies on an arc guide.
    OnArc(Site, Arc),
    /// A body's x-axis makes the angle with a straight guide; `None`: whatever it is now.
    Along(usize, Straight, Option<Num>),
    /// A body's x-axis makes the angle with the tangent of an arc (ccw about its centre) at a point.
    Around(usize, Site, Arc, Option<Num>),
    /// Two circles touch.
    Touch { centres: [Site; 2], radii: [Num; 2], internal: bool },
    /// A circle touches a line.
    TouchLine { centre: Site, line: Straight, radius: Num },
    /// Two circles roll on each other (Willis: r₁(ω₁ − ω_c) ± r₂(ω₂ − ω_c) = 0). Rates only.
    Roll { bodies: [usize; 2], centres: [Site; 2], radii: [Num; 2], internal: bool },
    /// A wheel rolls on a line. Rates only.
    RollLine { wheel: usize, centre: Site, line: Straight, radius: Num },
    /// The line between two points of a body has a driven angle; `None`: its x-axis.
    Turn(usize, Option<[[Num; 2]; 2]>, Drive),
    /// A point has a driven place along a straight guide.
    Push(Site, Straight, Drive),
    /// The line between two points of a body points as between two places.
    Aim(usize, [[Num; 2]; 2], [[Num; 2]; 2]),
    /// A coordinate of a body (3·body + axis) is zero.
    Hold(usize),
}

/// Where the bodies are and how they move, scaled.
#[derive(Debug, Clone, Copy)]
pub(super) struct Motion<'a> {
    /// Poses.
    pub(super) pose: &'a [f64],
    /// First derivatives; may be empty on a tape of order 0.
    pub(super) rate: &'a [f64],
    /// Second derivatives; may be empty on a tape of order below 2.
    pub(super) accel: &'a [f64],
    /// Parameters.
    pub(super) params: &'a [Param],
}

/// Formulas over one motion, recorded on one tape.
#[derive(Debug, Clone, Copy)]
pub(super) struct Scope<'t> {
    /// The record.
    pub(super) tape: &'t Tape,
    /// The motion.
    pub(super) motion: Motion<'t>,
}

/// The equations of all pairs, over whatever numbers they are to be evaluated in.
pub(super) trait Formulas {
    /// The numbers.
    type Number: Calculus;

    /// A number of the model.
    fn num(&self, num: Num) -> Self::Number;

    /// An exact number.
    fn exact(&self, value: f64) -> Self::Number;

    /// A coordinate of a body: 0 x, 1 y, 2 θ.
    fn coordinate(&self, body: usize, axis: usize) -> Self::Number;

    /// A driving function.
    fn drive(&self, drive: &Drive) -> Self::Number;

    /// Two numbers of the model.
    fn pair(&self, nums: [Num; 2]) -> [Self::Number; 2] {
        [self.num(nums[0]), self.num(nums[1])]
    }

    /// Angle of a body's x-axis.
    fn angle(&self, body: usize) -> Self::Number {
        self.coordinate(body, 2)
    }

    /// Place of a body's origin.
    fn origin(&self, body: usize) -> [Self::Number; 2] {
        [self.coordinate(body, 0), self.coordinate(body, 1)]
    }

    /// Place of a point of a body.
    fn site(&self, site: &Site) -> [Self::Number; 2] {
        if site.body == 0 {
            return self.pair(site.own);
        }
        if site.own == [Num::Exact(0.0); 2] {
            return self.origin(site.body);
        }
        plus(self.origin(site.body), self.carried_vector(site.body, site.own))
    }

    /// One coordinate of the place of a point of a body.
    fn site_along(&self, site: &Site, axis: usize) -> Self::Number {
        if site.body == 0 {
            return self.num(site.own[axis]);
        }
        let origin = self.coordinate(site.body, axis);
        if site.own == [Num::Exact(0.0); 2] {
            return origin;
        }
        let [cos, sin] = self.angle(site.body).cos_sin();
        let [x, y] = self.pair(site.own);
        origin + if axis == 0 { cos * x - sin * y } else { sin * x + cos * y }
    }

    /// A vector of a body's own coordinates as the body has turned it.
    fn carried_vector(&self, body: usize, own: [Num; 2]) -> [Self::Number; 2] {
        turned(self.pair(own), self.angle(body))
    }

    /// Angle of a straight guide's direction in its body.
    fn own_bearing(&self, guide: &Straight) -> Self::Number {
        let angle = match guide.bearing {
            Bearing::Angle(angle) => self.num(angle),
            Bearing::Toward(to) => {
                let along = minus(self.pair(to), self.pair(guide.through.own));
                along[1].atan2(along[0])
            }
        };
        angle + self.num(guide.turned)
    }

    /// Unit vector of a straight guide's direction.
    fn direction(&self, guide: &Straight) -> [Self::Number; 2] {
        let angle = self.angle(guide.through.body);
        match guide.bearing {
            Bearing::Angle(own) => (angle + self.num(own) + self.num(guide.turned)).cos_sin(),
            Bearing::Toward(to) => {
                let along = minus(self.pair(to), self.pair(guide.through.own));
                let length = dot(along, along).sqrt();
                turned([along[0] / length, along[1] / length], angle + self.num(guide.turned))
            }
        }
    }

    fn distance_equation(&self, square: Self::Number, radius: Self::Number) -> Self::Number {
        // (d² − r²) / 2r: smooth everywhere, and to first order d − r where it holds.
        (square - radius * radius) / (radius * self.exact(2.0))
    }

    /// The equation as a function of time.
    fn row(&self, row: &Row) -> Self::Number {
        match row {
            Row::Coincide(a, b, axis) => self.site_along(a, *axis) - self.site_along(b, *axis),
            Row::OnLine(rider, guide) => {
                let normal = quarter(self.direction(guide));
                let from = minus(self.site(rider), self.site(&guide.through));
                dot(normal, from) - self.num(guide.offset)
            }
            Row::OnArc(rider, guide) => {
                let from = minus(self.site(rider), self.site(&guide.centre));
                self.distance_equation(dot(from, from), self.num(guide.radius))
            }
            Row::Along(body, guide, against) => {
                let turn = self.angle(*body) - self.angle(guide.through.body);
                match against {
                    Some(angle) => (turn - self.own_bearing(guide) - self.num(*angle)).wrapped(),
                    None => turn,
                }
            }
            Row::Around(body, rider, guide, against) => {
                // The own x-axis of what rides on an arc is the radius, outward.
                let from = minus(self.site(rider), self.site(&guide.centre));
                let turn = self.angle(*body) - from[1].atan2(from[0]);
                match against {
                    Some(angle) => (turn - self.num(*angle)).wrapped(),
                    None => turn,
                }
            }
            Row::Touch { centres, radii, internal } => {
                let from = minus(self.site(&centres[1]), self.site(&centres[0]));
                let [first, second] = self.pair(*radii);
                let sum = if *internal { first - second } else { first + second };
                let sum = if sum.value() < 0.0 { -sum } else { sum };
                self.distance_equation(dot(from, from), sum)
            }
            Row::TouchLine { centre, line, radius } => {
                let away = self.above(centre, line);
                self.distance_equation(away * away, self.num(*radius))
            }
            Row::Roll { bodies, centres, radii, internal } => {
                let from = minus(self.site(&centres[1]), self.site(&centres[0]));
                let carrier = from[1].atan2(from[0]);
                let [first, second] = self.pair(*radii);
                let first = first * (self.angle(bodies[0]) - carrier);
                let second = second * (self.angle(bodies[1]) - carrier);
                if *internal { first - second } else { first + second }
            }
            Row::RollLine { wheel, centre, line, radius } => {
                let along = dot(self.direction(line), minus(self.site(centre), self.site(&line.through)));
                let turn = self.angle(*wheel) - self.angle(line.through.body);
                let rolled = self.num(*radius) * turn;
                if self.above(centre, line).value() < 0.0 { along - rolled } else { along + rolled }
            }
            Row::Turn(body, joints, drive) => {
                let own = match joints {
                    Some([from, to]) => {
                        let line = minus(self.pair(*to), self.pair(*from));
                        line[1].atan2(line[0])
                    }
                    None => self.exact(0.0),
                };
                (self.angle(*body) + own - self.drive(drive)).wrapped()
            }
            Row::Push(rider, guide, drive) => {
                let from = minus(self.site(rider), self.site(&guide.through));
                dot(self.direction(guide), from) - self.drive(drive)
            }
            Row::Aim(body, own, world) => {
                let own = minus(self.pair(own[1]), self.pair(own[0]));
                let world = minus(self.pair(world[1]), self.pair(world[0]));
                (self.angle(*body) + own[1].atan2(own[0]) - world[1].atan2(world[0])).wrapped()
            }
            Row::Hold(at) => self.coordinate(at / 3, at % 3),
        }
    }

    /// Height of a point above a guide's line, to its left.
    fn above(&self, point: &Site, line: &Straight) -> Self::Number {
        let from = minus(self.site(point), self.site(&line.through));
        dot(quarter(self.direction(line)), from) - self.num(line.offset)
    }
}

impl<'t> Formulas for Scope<'t> {
    type Number = Jet<'t>;

    /// A number of the model.
    fn num(&self, num: Num) -> Jet<'t> {
        self.tape.steady(match num {
            Num::Exact(value) => self.tape.constant(value),
            Num::Param(index) => self.tape.leaf(Leaf::Param(index), self.motion.params[index].value),
        })
    }

    fn exact(&self, value: f64) -> Jet<'t> {
        self.tape.number(value)
    }

    /// A coordinate of a body: 0 x, 1 y, 2 θ.
    fn coordinate(&self, body: usize, axis: usize) -> Jet<'t> {
        if body == 0 {
            return self.tape.number(0.0);
        }
        let at = 3 * body + axis;
        let or_zero = |values: &[f64], leaf: Leaf| match values.get(at) {
            Some(value) => self.tape.leaf(leaf, *value),
            None => self.tape.constant(0.0),
        };
        Jet {
            v: or_zero(self.motion.pose, Leaf::Pose(at)),
            d: or_zero(self.motion.rate, Leaf::Rate(at)),
            a: or_zero(self.motion.accel, Leaf::Accel(at)),
        }
    }

    fn drive(&self, drive: &Drive) -> Jet<'t> {
        let mut rate = self.num(drive.rate).v;
        if let Some([from, to]) = drive.arm {
            let arm = minus(self.pair(to), self.pair(from));
            rate = rate / dot(arm, arm).sqrt().v;
        }
        Jet { v: self.num(drive.value).v, d: rate, a: self.num(drive.second).v }
    }
}

impl<'t> Scope<'t> {
    /// Place of the material point of a body that is at a given place now: the body's velocity and
    /// acceleration field at that place.
    pub(super) fn carried(&self, body: usize, place: Vector<'t>) -> Vector<'t> {
        if body == 0 {
            return [self.tape.steady(place[0].v), self.tape.steady(place[1].v)];
        }
        // o(t) + R(θ(t) − θ₀)(p₀ − o₀): the turn since now is zero now, so cos = 1 and sin = 0 exactly.
        let origin = self.origin(body);
        let angle = self.angle(body);
        let arm = [self.tape.steady(place[0].v - origin[0].v), self.tape.steady(place[1].v - origin[1].v)];
        let turn = Jet { v: self.tape.constant(0.0), ..angle };
        plus(origin, turned(arm, turn))
    }
}

impl Row {
    /// The equation's derivative of the given order (0, 1, 2) in time, with its partial derivatives.
    /// `None` where it divides by zero: a link without length, a circle on its own centre.
    pub(super) fn linear(&self, motion: Motion<'_>, order: u8) -> Option<Linear> {
        let tape = Tape::new(order);
        let out = Scope { tape: &tape, motion }.row(self).at(order);
        let linear = tape.sweep(out);
        (!tape.broken() && linear.value.is_finite() && linear.rounding.is_finite()).then_some(linear)
    }

    /// Whether the equation, with all other unknowns known, is linear in the angle or in the place that
    /// it determines, so that it has one solution.
    pub(super) fn is_simple(&self) -> bool {
        matches!(self, Self::Along(..) | Self::Around(..) | Self::Turn(..) | Self::Aim(..) | Self::Hold(_))
    }

    /// Whether the equation is linear in the places of bodies whose angles are known.
    pub(super) fn is_linear_in_places(&self) -> bool {
        self.is_simple() && !matches!(self, Self::Around(..))
            || matches!(self, Self::Coincide(..) | Self::OnLine(..) | Self::Push(..))
    }

    /// Whether the equation, with the angle of one turning body unknown, has the form a cos θ + b sin θ = c: two
    /// solutions at most.
    pub(super) fn is_circular(&self) -> bool {
        // A point of the turning body, or of one that is carried along without turning, lies at c + r(θ), r turned by
        // θ; a normal is fixed or turns as well. Then their products, and the square of a distance, are of first
        // degree in cos θ and sin θ.
        matches!(
            self,
            Self::Coincide(..) | Self::OnLine(..) | Self::OnArc(..) | Self::Touch { .. } | Self::Push(..)
        )
    }

    /// Whether the equation is a coordinate, or its negative, and terms without it.
    pub(super) fn is_plain_in(&self, column: usize) -> bool {
        match self {
            Self::Coincide(a, b, axis) => column % 3 == *axis && a.body != b.body,
            Self::Along(..) | Self::Turn(..) | Self::Aim(..) => column % 3 == 2,
            Self::Hold(at) => column == *at,
            _ => false,
        }
    }

    /// Whether the equation may depend on the coordinates of a body.
    pub(super) fn hangs_on(&self, body: usize) -> bool {
        self.all_bodies().contains(&body)
    }

    /// The bodies on whose coordinates the equation may hang; some of them twice.
    pub(super) fn all_bodies(&self) -> [usize; 4] {
        let [first, second] = self.bodies();
        let others = match self {
            Self::Around(_, rider, ..) => [rider.body; 2],
            Self::Roll { centres, .. } => [centres[0].body, centres[1].body],
            Self::RollLine { centre, .. } => [centre.body; 2],
            _ => [first; 2],
        };
        [first, second, others[0], others[1]]
    }

    /// The bodies that the equation binds.
    pub(super) fn bodies(&self) -> [usize; 2] {
        match self {
            Self::Coincide(a, b, _) => [a.body, b.body],
            Self::OnLine(rider, guide) | Self::Push(rider, guide, _) => [rider.body, guide.through.body],
            Self::OnArc(rider, guide) => [rider.body, guide.centre.body],
            Self::Along(body, guide, _) => [*body, guide.through.body],
            Self::Around(body, _, guide, _) => [*body, guide.centre.body],
            Self::Touch { centres, .. } => [centres[0].body, centres[1].body],
            Self::TouchLine { centre, line, .. } => [centre.body, line.through.body],
            Self::Roll { bodies, .. } => *bodies,
            Self::RollLine { wheel, line, .. } => [*wheel, line.through.body],
            Self::Turn(body, ..) | Self::Aim(body, ..) => [*body, *body],
            Self::Hold(at) => [at / 3, at / 3],
        }
    }
}
