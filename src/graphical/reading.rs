//! Reads the asked quantities off the finished diagrams.

use std::collections::HashMap;

use crate::board::{
    Amount, Angle, Arithmetic, Direction, Judged, Line, Location, Point, Real, TOO_LARGE, Tape,
};
use crate::double_double::DoubleDouble;
use crate::mechanism::force::{Action, Force};
use crate::mechanism::quantity::{Answer, Asked, Indeterminate, Method, Order, Quantity};
use crate::mechanism::{LinkId, PointId};
use crate::plan::{Auxiliary, chord, home, transmission_points};

use super::auxiliary::KleinAnswer;
use super::centres::{FromCentres, NO_INPUT};
use super::construction::{Act, Calculation, Claim, Fine, Label, Reading, Reference, Vector, VectorKind};
use super::draughtsman::Draughtsman;
use super::forces::ForceRead;
use super::missing::Missing;
use super::shown::Standing;

/// What stands for a quantity on the board.
enum Read {
    Vector([Amount; 2]),
    Scalar(Amount),
    Angle(Angle),
    Toward(Direction, Angle),
    Undefined(&'static str),
}

/// What was read off for an asked quantity.
pub(super) struct ReadOff {
    /// Marks and values, two for a vector; or why there are none.
    pub(super) numbers: Marked,
    /// The direction of a place at infinity; its angle is the number.
    pub(super) toward: Option<[f64; 2]>,
    /// How long it was drawn.
    drawn_mm: Option<f64>,
    /// A point of the line of a force.
    pub(super) through: Option<[f64; 2]>,
    /// What it turns about the place where it acts first, N·m.
    couple: Option<f64>,
}

/// Marks and values of a read quantity, or why there are none.
pub(super) type Marked = Result<Vec<(u32, f64)>, &'static str>;

/// Why there is no centre of two links whose velocities show none of the one against the other.
const STILL: &str = "the two links do not move against each other";

/// Longer than any sheet, mm.
const SHEET: f64 = 1e5;

/// Reads every asked quantity, with its bound from the tape.
pub(super) fn answers(d: &mut Draughtsman<'_>) -> (Vec<Reading>, Vec<Vec<u32>>) {
    let read = read_all(d);
    let slots: Vec<Vec<u32>> =
        read.iter().map(|read| read.numbers.iter().flatten().map(|(mark, _)| *mark).collect()).collect();
    let judged = d.board.tape().judged(&slots.concat());
    let mut judged = judged.as_slice();
    let asked = d.mechanism.asked.iter().map(|asked| asked.quantity);
    let readings = read
        .into_iter()
        .zip(&slots)
        .zip(asked)
        .map(|((read, slots), quantity)| {
            let (own, rest) = judged.split_at(slots.len());
            judged = rest;
            let (answer, fine) = match (quantity, read.numbers.as_ref()) {
                (Quantity::Centre(i, j), Err(&STILL)) => (d.no_centre(i, j), None),
                _ => d.answer(&read, own),
            };
            // What is no force has no line; what it turns by no more than its bound on an arm as long as the sheet is none.
            let none = if let Answer::Vector { bound, .. } = answer {
                answer.may_be_zero().then_some(bound)
            } else {
                None
            };
            let through = read.through.filter(|_| none.is_none());
            let couple = read
                .couple
                .zip(none)
                .filter(|(couple, bound)| couple.abs() > bound * SHEET * d.scales.length());
            let zero = d.record().is_told_as_zero(&quantity, &answer);
            Reading {
                answer,
                zero,
                fine,
                drawn_mm: read.drawn_mm,
                through,
                couple: couple.map(|(couple, _)| couple),
            }
        })
        .collect();
    (readings, slots)
}

/// Vectors of a diagram by what they stand for, as far as somebody asked.
#[derive(Debug, Default)]
pub(super) struct Listed {
    /// The first for each quantity.
    first: HashMap<Quantity, usize>,
    /// How many of the diagram's vectors are listed.
    count: usize,
}

/// An asked quantity in the arithmetic of its board.
#[derive(Debug, Clone, PartialEq)]
pub struct Numbers<R> {
    /// One number, or the two coordinates of a vector; SI units.
    pub value: Vec<R>,
    /// The truth is no farther away; `None` from a board that keeps no record.
    pub bound: Option<f64>,
}

/// What every asked quantity reads on a board of any arithmetic; `None` where it is not determined, or a
/// direction instead of a place.
pub(super) fn numbers<R: Real>(
    d: &mut Draughtsman<'_>,
    bound: impl Fn(&mut Tape, u32) -> Option<Option<f64>>,
) -> Vec<Option<Numbers<R>>> {
    let read = read_all(d);
    read.into_iter()
        .map(|read| {
            let numbers = read.numbers.ok().filter(|_| read.toward.is_none())?;
            let tape = d.board.tape();
            let bounds: Option<Vec<Option<f64>>> = numbers.iter().map(|(m, _)| bound(tape, *m)).collect();
            let together = |sum: f64, bound: f64| libm::hypot(sum, bound);
            let bound = bounds?.into_iter().try_fold(0.0, |sum, bound| Some(together(sum, bound?)));
            let value = numbers.into_iter().map(|(mark, value)| tape.number(mark, value)).collect();
            Some(Numbers { value, bound })
        })
        .collect()
}

/// Reads every asked quantity.
pub(super) fn read_all(d: &mut Draughtsman<'_>) -> Vec<ReadOff> {
    let asked = d.mechanism.asked.clone();
    asked.iter().enumerate().map(|(index, asked)| d.read_off(index, asked)).collect()
}

impl Draughtsman<'_> {
    fn read_off(&mut self, index: usize, asked: &Asked) -> ReadOff {
        let read = match (asked.method, asked.quantity) {
            (Method::Klein, _) => self.read_klein(&asked.quantity),
            (
                Method::TwoMasses { first, second },
                Quantity::Force(Force::Vector(Action::Inertia(link)), _),
            ) => return self.read_by_two_masses(link, (first, second)),
            (Method::Lever, Quantity::Force(Force::Torque(input) | Force::Drive(input), _)) => {
                self.effort_by_lever(input).map_or_else(Read::Undefined, Read::Scalar)
            }
            (Method::ThreeForce | Method::Components, Quantity::Force(force, share)) => {
                match self.route_refused(force, share) {
                    Some(why) => Read::Undefined(why),
                    None => self.read_quantity(&asked.quantity),
                }
            }
            _ if asked.by_centres() => self.read_from_centres(index),
            _ => self.read_quantity(&asked.quantity),
        };
        let of_polygon = asked.method != Method::Klein;
        let drawn_mm = of_polygon.then(|| self.drawn_length(&asked.quantity)).flatten();
        let (numbers, toward) = read.numbers();
        let (through, couple) = match asked.quantity {
            Quantity::Force(Force::Vector(action), share) => self.line_and_couple(action, share),
            _ => (None, None),
        };
        ReadOff { numbers, toward, drawn_mm, through, couple }
    }

    /// The inertia force of a link, with the line that two masses gave it.
    fn read_by_two_masses(&mut self, link: LinkId, masses: (PointId, Option<PointId>)) -> ReadOff {
        let found = self.force_by_two_masses(link, masses);
        let through = found.ok().map(|found| self.in_the_world(found.through));
        let read = match found {
            Ok(found) => Read::Vector(self.components_of(found.pull)),
            Err(why) => Read::Undefined(why),
        };
        let (numbers, toward) = read.numbers();
        ReadOff { numbers, toward, drawn_mm: None, through, couple: None }
    }

    /// What stands on the paper for a quantity.
    pub(super) fn read_standing(&mut self, quantity: &Quantity) -> Standing {
        self.read_quantity(quantity).numbers()
    }
}

impl Read {
    fn numbers(self) -> Standing {
        match self {
            Self::Vector([x, y]) => (Ok(vec![(x.mark(), x.value()), (y.mark(), y.value())]), None),
            Self::Scalar(a) => (Ok(vec![(a.mark(), a.value())]), None),
            Self::Angle(a) => (Ok(vec![(a.mark(), a.value())]), None),
            Self::Toward(direction, a) => (Ok(vec![(a.mark(), a.value())]), Some(direction.value())),
            Self::Undefined(why) => (Err(why), None),
        }
    }
}

impl Draughtsman<'_> {
    fn answer(&mut self, read: &ReadOff, judged: &[Judged]) -> (Answer, Option<Fine>) {
        let undefined = |why: &str| Answer::Indeterminate(Indeterminate::Undefined { why: why.to_owned() });
        let numbers = match &read.numbers {
            Ok(numbers) => numbers,
            Err(why) if [super::forces::NO_SPEED, super::forces::PULLS].contains(why) => {
                return (
                    Answer::Indeterminate(Indeterminate::NoEquilibrium { why: (*why).to_owned() }),
                    None,
                );
            }
            Err(why) => return (undefined(why), None),
        };
        let weak = judged.iter().find_map(|number| number.weakness);
        let too_large = || (undefined("a number on the way is too large for this arithmetic"), None);
        if weak == Some(TOO_LARGE) {
            return too_large();
        }
        if let Some(reason) = weak {
            return (Answer::Indeterminate(self.why(reason)), None);
        }
        let bounds: Vec<f64> = judged.iter().map(|number| number.bound).collect();
        if !bounds.iter().all(|bound| bound.is_finite()) {
            return too_large();
        }
        let values: Vec<f64> = numbers.iter().map(|&(_, value)| value).collect();
        let tape = self.board.tape();
        let digits: Vec<DoubleDouble> =
            numbers.iter().map(|&(mark, value)| tape.number(mark, value)).collect();
        // The answer is rounded to a double: what that leaves belongs to its bound.
        let rounded = |i: usize| bounds[i] + digits[i].lo().abs();
        let answer = match (read.toward, &values[..]) {
            (Some(direction), [_]) => return (Answer::AtInfinity { direction, bound: rounded(0) }, None),
            (None, &[value]) => Answer::Scalar { value, bound: rounded(0) },
            (None, &[x, y]) => Answer::Vector { value: [x, y], bound: libm::hypot(rounded(0), rounded(1)) },
            _ => undefined("nothing was read"),
        };
        let fine = matches!(tape.arithmetic(), Arithmetic::DoubleDouble | Arithmetic::Wide).then(|| Fine {
            value: digits.clone(),
            bound: bounds.iter().fold(0.0, |sum, b| libm::hypot(sum, *b)),
        });
        (answer, fine)
    }
}

impl Draughtsman<'_> {
    /// The paper length of the vector that stands for a quantity.
    fn drawn_length(&mut self, quantity: &Quantity) -> Option<f64> {
        [Order::Velocity, Order::Acceleration].into_iter().find_map(|order| {
            let vector = self.vector_of(order, *quantity)?;
            let vector = self.polygon(order)?.vectors.get(vector)?;
            Some(libm::hypot(vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]))
        })
    }

    /// The first vector of the paper that is this quantity. A point against that of a link under a pin of another is not the
    /// point against the pin, though it is named by both.
    fn vector_of(&mut self, order: Order, quantity: Quantity) -> Option<usize> {
        /// So many are looked through as fast as they are listed.
        const FEW: usize = 64;
        let mechanism = self.mechanism;
        let under = |label: Label| match label {
            Label::Image { point, link: Some(link) } | Label::Foot { point, link: Some(link), .. } => {
                !mechanism.link(link).points.contains(&point)
            }
            _ => false,
        };
        let stands_for = |vector: &Vector| {
            let by_points = matches!(
                vector.quantity,
                Quantity::RelativeVelocity(..) | Quantity::RelativeAcceleration(..)
            );
            !(by_points && (under(vector.tail) || under(vector.head)))
        };
        let mut listed = std::mem::take(&mut self.vectors_of);
        let found = self.polygon(order).and_then(|polygon| {
            let vectors = &polygon.vectors;
            if vectors.len() <= FEW {
                return vectors.iter().position(|v| v.quantity == quantity && stands_for(v));
            }
            let Listed { first, count } = &mut listed[usize::from(order == Order::Acceleration)];
            for (index, vector) in vectors.iter().enumerate().skip(*count).filter(|(_, v)| stands_for(v)) {
                first.entry(vector.quantity).or_insert(index);
            }
            *count = vectors.len();
            first.get(&quantity).copied()
        });
        self.vectors_of = listed;
        found
    }

    /// What Klein's construction says of a quantity.
    fn read_klein(&mut self, quantity: &Quantity) -> Read {
        match self.klein_answer(quantity) {
            KleinAnswer::Vector(vector) => Read::Vector(vector),
            KleinAnswer::Scalar(scalar) => Read::Scalar(scalar),
            KleinAnswer::None => {
                let refused = self.record().auxiliary.iter().find_map(|drawing| match drawing.kind {
                    Auxiliary::Klein { crank, .. } if crank.leads_to(quantity) => drawing.refused,
                    _ => None,
                });
                Read::Undefined(refused.unwrap_or(
                    "Klein's construction leads to the pins and the rod of a slider-crank with a driven crank only",
                ))
            }
        }
    }

    /// A velocity or an angular velocity by one of the methods of instant centres.
    fn read_from_centres(&self, index: usize) -> Read {
        match self.transferred.iter().find(|(of, _)| *of == index) {
            Some((_, Ok(FromCentres::Vector(components)))) => Read::Vector(*components),
            Some((_, Ok(FromCentres::Scalar(rate)))) => Read::Scalar(*rate),
            Some((_, Err(why))) => Read::Undefined(why),
            None => Read::Undefined(NO_INPUT),
        }
    }

    fn read_quantity(&mut self, quantity: &Quantity) -> Read {
        if let (Err(why), false) = (self.fed, matches!(quantity.order(), Order::Position)) {
            return Read::Undefined(why);
        }
        match *quantity {
            Quantity::Velocity(p) => self.read_absolute(Order::Velocity, p, *quantity),
            Quantity::Acceleration(p) => self.read_absolute(Order::Acceleration, p, *quantity),
            Quantity::RelativeVelocity(b, a) => self.read_relative(Order::Velocity, b, a, *quantity),
            Quantity::RelativeAcceleration(b, a) => self.read_relative(Order::Acceleration, b, a, *quantity),
            Quantity::RelativeNormal(b, a) => self.read_component(b, a, true),
            Quantity::RelativeTangential(b, a) => self.read_component(b, a, false),
            Quantity::Normal(p) | Quantity::Tangential(p) => match self.pivot_of(p) {
                Some(pivot) => self.read_component(p, pivot, matches!(quantity, Quantity::Normal(_))),
                None => Read::Undefined("the point's link has no fixed pivot"),
            },
            Quantity::Omega(l) => Read::Scalar(self.rate(Order::Velocity, l)),
            Quantity::Alpha(l) => Read::Scalar(self.rate(Order::Acceleration, l)),
            Quantity::RelativeOmega(i, j) => self.read_difference(Order::Velocity, i, j),
            Quantity::Ratio(i, j) | Quantity::Advantage(j, i) => {
                let (first, second) = (self.rate(Order::Velocity, i), self.rate(Order::Velocity, j));
                let reason = self.reason_missing(Missing::Turning(j));
                // Both the other way: what divides is no number of its own but this one's, so that it spoils nothing else.
                let (first, second) = (self.board.opposite(first), self.board.opposite(second));
                Read::Scalar(self.board.quotient(first, second, reason))
            }
            Quantity::RelativeAlpha(i, j) => self.read_difference(Order::Acceleration, i, j),
            Quantity::Rub(pin, i, j) => self.read_rub(pin, i, j),
            Quantity::PathRadius(p) => self.read_path_radius(p),
            Quantity::Position(p) => self.read_position(p),
            Quantity::Angle(l) => Read::Angle(self.read_angle(l)),
            Quantity::Transmission(i, j) => self.read_transmission(i, j),
            Quantity::Slip(_, link)
            | Quantity::CoincidentVelocity(_, link)
            | Quantity::TurningVelocity(.., link) => self.read_part(Order::Velocity, quantity, link),
            Quantity::SlipAcceleration(_, link)
            | Quantity::SlipNormal(_, link)
            | Quantity::SlipTangential(_, link)
            | Quantity::Coriolis(_, link)
            | Quantity::TurningNormal(.., link)
            | Quantity::TurningTangential(.., link)
            | Quantity::ContactNormal(_, link, _)
            | Quantity::CoincidentAcceleration(_, link)
            | Quantity::CoincidentNormal(_, link)
            | Quantity::CoincidentTangential(_, link) => self.read_part(Order::Acceleration, quantity, link),
            Quantity::Centre(i, j) => self.read_centre(i, j),
            Quantity::Cycle(_) => Read::Undefined("it is read off the turning-moment diagram"),
            Quantity::Force(force, share) => match self.read_force(force, share) {
                ForceRead::Vector(components) => Read::Vector(components),
                ForceRead::Scalar(amount) => Read::Scalar(amount),
                ForceRead::AtInfinity => {
                    let right = self.board.rightward();
                    let angle = self.board.measure_angle(right);
                    Read::Toward(right, angle)
                }
                ForceRead::Undefined(why) => Read::Undefined(why),
            },
        }
    }

    pub(super) fn rate(&mut self, order: Order, link: LinkId) -> Amount {
        match self.motion(order).rotations[link.0] {
            Some(rate) => rate,
            None if self.translates[link.0] => self.rest(),
            None => {
                let reason = self.miss_of(Missing::Rate(order, link));
                self.board.unknown(reason)
            }
        }
    }

    /// A sliding, Coriolis or coincident vector, where one was drawn.
    fn read_part(&mut self, order: Order, quantity: &Quantity, link: LinkId) -> Read {
        let drawn = self.parts.iter().rev().find(|p| p.quantity == *quantity).map(|p| (p.tail, p.head));
        match drawn {
            Some((tail, head)) => self.read_vector(order, tail, head),
            // A guide that cannot turn gives no Coriolis acceleration.
            None if matches!(quantity, Quantity::Coriolis(..)) && self.translates[link.0] => {
                Read::Vector([self.rest(), self.rest()])
            }
            None => match *quantity {
                Quantity::Slip(pin, _) => {
                    let (under, image) = (self.image_under(order, pin, link), self.image(order, pin));
                    self.read_vector(order, under, image)
                }
                Quantity::CoincidentNormal(..) | Quantity::CoincidentTangential(..)
                    if link == LinkId::FRAME =>
                {
                    Read::Vector([self.rest(), self.rest()])
                }
                Quantity::CoincidentNormal(pin, _) => self.read_part_under(pin, link, true),
                Quantity::CoincidentTangential(pin, _) => self.read_part_under(pin, link, false),
                Quantity::SlipAcceleration(pin, _) if link == LinkId::FRAME => {
                    let (pole, image) = (self.board.origin(), self.image(order, pin));
                    self.read_vector(order, pole, image)
                }
                Quantity::CoincidentVelocity(pin, _) | Quantity::CoincidentAcceleration(pin, _) => {
                    self.step(order, &[link], Vec::new());
                    let (pole, image) = (self.board.origin(), self.image_under(order, pin, link));
                    self.read_vector(order, pole, image)
                }
                _ => Read::Undefined("no construction drew this vector"),
            },
        }
    }

    /// Normal or tangential part of the acceleration of the point of a pivoted link under a pin, where the link was solved
    /// by another one: the normal part is laid off from the image of the pivot, and what is left leads to that of the point.
    fn read_part_under(&mut self, pin: PointId, link: LinkId, normal: bool) -> Read {
        let order = Order::Acceleration;
        let points = self.mechanism.link(link).points.clone();
        let Some(pivot) = points.into_iter().find(|&point| self.mechanism.is_fixed(point)) else {
            return Read::Undefined("the link has no fixed pivot");
        };
        self.board.purpose("components asked for");
        self.step(order, &[link], Vec::new());
        let image = self.image_under(order, pin, link);
        let quantities = (Quantity::CoincidentNormal(pin, link), Quantity::CoincidentTangential(pin, link));
        if !self.parts.iter().any(|part| part.quantity == quantities.0) {
            let label = Label::Foot { point: pin, link: Some(link), index: 3 };
            let foot = self.lay_off_normal(link, pin, pivot, label);
            let head = (self.label_under(pin, link), image);
            let claim = Claim::Perpendicular(Reference::Points(pivot, pin));
            let part = (VectorKind::Tangential, quantities.1, Some(claim));
            let vector = self.note_vector(order, part, (label, foot), head);
            self.act_read(order, vector);
            self.note_part(quantities.1, foot, image);
        }
        let wanted = if normal { quantities.0 } else { quantities.1 };
        match self.parts.iter().rev().find(|part| part.quantity == wanted).map(|part| (part.tail, part.head))
        {
            Some((tail, head)) => self.read_vector(order, tail, head),
            None => Read::Undefined("no construction drew this vector"),
        }
    }

    fn read_vector(&mut self, order: Order, from: Point, to: Point) -> Read {
        let scale = self.polygon_scale(order);
        let [x, y] = self.board.between(from, to);
        Read::Vector([self.board.read(x, scale), self.board.read(y, scale)])
    }

    fn read_absolute(&mut self, order: Order, p: PointId, quantity: Quantity) -> Read {
        let pole = self.board.origin();
        let image = self.image(order, p);
        if !self.mechanism.is_fixed(p) {
            let to = (self.label(p), image);
            self.ensure_vector(order, (VectorKind::Absolute, quantity), (Label::Pole, pole), to);
        }
        self.read_vector(order, pole, image)
    }

    fn read_relative(&mut self, order: Order, b: PointId, a: PointId, quantity: Quantity) -> Read {
        let (from, to) = (self.image(order, a), self.image(order, b));
        let (tail, head) = ((self.label(a), from), (self.label(b), to));
        self.ensure_vector(order, (VectorKind::Relative, quantity), tail, head);
        self.read_vector(order, from, to)
    }

    /// Draws the vector of an asked quantity if no step has drawn it.
    fn ensure_vector(
        &mut self,
        order: Order,
        (kind, quantity): (VectorKind, Quantity),
        tail: (Label, Point),
        head: (Label, Point),
    ) {
        if self.silent || self.vector_of(order, quantity).is_some() {
            return;
        }
        let found_with = match head.0 {
            Label::Image { point, .. } => home(self.mechanism, self.structure, point),
            Label::Pole | Label::Foot { .. } | Label::Trial { .. } => None,
        };
        self.step(order, found_with.as_slice(), Vec::new());
        let vector = self.note_vector(order, (kind, quantity, None), tail, head);
        self.act_read(order, vector);
    }

    /// The fixed pivot of the link whose group finds a point.
    fn pivot_of(&self, point: PointId) -> Option<PointId> {
        let with_pivot = |link: LinkId| {
            self.mechanism.link(link).points.iter().copied().find(|&p| self.mechanism.is_fixed(p))
        };
        home(self.mechanism, self.structure, point).and_then(with_pivot).or_else(|| {
            let links = &self.mechanism.point(point).links;
            links.iter().copied().filter(|&l| l != LinkId::FRAME).find_map(with_pivot)
        })
    }

    /// Normal or tangential part of A_BA, for two points of one link.
    fn read_component(&mut self, b: PointId, a: PointId, normal: bool) -> Read {
        let links = self.mechanism.point(a).links.iter().copied();
        let carries = |l: &LinkId| *l != LinkId::FRAME && !self.mechanism.link(*l).block;
        let shared = links.filter(carries).filter(|l| self.mechanism.link(*l).points.contains(&b)).min();
        let Some(link) = shared else { return Read::Undefined("the two points are of different links") };
        let drawn = self.feet.iter().find(|f| f.link == link && f.points == [b, a]).map(|f| (f.tail, f.head));
        let (from, foot) = match drawn {
            Some(drawn) => drawn,
            None => {
                self.board.purpose("components asked for");
                self.step(Order::Acceleration, &[link], Vec::new());
                let label = Label::Foot { point: b, link: None, index: 3 };
                let foot = self.lay_off_normal(link, b, a, label);
                let image = self.image(Order::Acceleration, b);
                let fixed = self.mechanism.is_fixed(a);
                let quantity =
                    if fixed { Quantity::Tangential(b) } else { Quantity::RelativeTangential(b, a) };
                let head = (self.label(b), image);
                let vector = self.note_vector(
                    Order::Acceleration,
                    (VectorKind::Tangential, quantity, None),
                    (label, foot),
                    head,
                );
                self.act_read(Order::Acceleration, vector);
                (self.image(Order::Acceleration, a), foot)
            }
        };
        if normal {
            return self.read_vector(Order::Acceleration, from, foot);
        }
        let image = self.image(Order::Acceleration, b);
        self.read_vector(Order::Acceleration, foot, image)
    }

    fn read_difference(&mut self, order: Order, i: LinkId, j: LinkId) -> Read {
        let (first, second) = (self.rate(order, i), self.rate(order, j));
        Read::Scalar(self.board.difference(first, second))
    }

    /// V_r = r |ω_i − ω_j|.
    fn read_rub(&mut self, pin: PointId, i: LinkId, j: LinkId) -> Read {
        let Some(journal) = self.mechanism.point(pin).journal else {
            return Read::Undefined("the pin has no journal radius");
        };
        let (first, second) = (self.rate(Order::Velocity, i), self.rate(Order::Velocity, j));
        let radius = self.board.amount(journal);
        let relative = self.board.difference(first, second);
        let relative = self.board.magnitude(relative);
        let value = self.board.product(radius, relative);
        self.rubbing_step();
        self.act(Act::Calculate(Calculation::Rub {
            pin,
            links: [i, j],
            radius: radius.value(),
            first: first.value(),
            second: second.value(),
            value: value.value(),
        }));
        Read::Scalar(value)
    }

    /// ρ = V² / Aⁿ, with Aⁿ the part of the acceleration square to V.
    fn read_path_radius(&mut self, p: PointId) -> Read {
        if self.mechanism.is_fixed(p) {
            return Read::Undefined("the point does not move");
        }
        let (pole, end) = (self.board.origin(), self.image(Order::Velocity, p));
        let reason = self.reason(&[]);
        let (along, mm) = self.board.toward(pole, end, reason);
        if self.board.is_nothing(mm) {
            return Read::Undefined("the point stands still here");
        }
        let image = self.image(Order::Acceleration, p);
        let [_, across] = self.board.square_off(Line { through: pole, along }, image);
        if self.board.is_nothing(across) {
            return Read::Undefined("the path runs straight here");
        }
        let (velocity, acceleration) =
            (self.polygon_scale(Order::Velocity), self.polygon_scale(Order::Acceleration));
        let speed = self.board.read(mm, velocity);
        let normal = self.board.read(across, acceleration);
        let normal = self.board.magnitude(normal);
        let radius = self.board.square_over(speed, normal, reason);
        Read::Scalar(radius)
    }

    /// The place in the world: as given for a fixed or placed point, else read off the skeleton.
    fn read_position(&mut self, p: PointId) -> Read {
        if let Some([x, y]) = self.mechanism.point(p).place.exact() {
            return Read::Vector([self.board.amount(x), self.board.amount(y)]);
        }
        let at = self.at(p);
        Read::Vector(self.in_world(at))
    }

    /// A place of the skeleton in the world.
    pub(super) fn in_world(&mut self, at: Point) -> [Amount; 2] {
        let scale = self.length_scale();
        let from = self.board.origin();
        let [x, y] = self.board.between(from, at);
        let origin = self.origin_of_space();
        let along = [x, y].map(|mm| self.board.read(mm, scale));
        let start = origin.map(|g| self.board.amount(g));
        [self.board.sum(start[0], along[0]), self.board.sum(start[1], along[1])]
    }

    /// Why two links that do not move against each other have no centre, with their numbers.
    fn no_centre(&self, i: LinkId, j: LinkId) -> Answer {
        let [i, j] = [i, j].map(|link| self.mechanism.link(link).number);
        let why = format!("links {i} and {j} do not move against each other");
        Answer::Indeterminate(Indeterminate::Undefined { why })
    }

    /// An instant centre: its place in the world, or the direction in which it lies at infinity.
    fn read_centre(&mut self, i: LinkId, j: LinkId) -> Read {
        if i == j {
            return Read::Undefined("a link has no motion against itself");
        }
        let Some(&centre) = self.centres.known.get(&chord(i, j)) else {
            return Read::Undefined(match self.centres.still.contains(&chord(i, j)) {
                true => STILL,
                false => "no two triangles of the circle diagram lead to this centre",
            });
        };
        let reason = self.reason(&[i, j]);
        match self.board.locate(centre, reason) {
            Location::Toward(direction, angle) => Read::Toward(direction, angle),
            Location::At(at) => Read::Vector(self.in_world(at)),
        }
    }

    /// Angle of a link's own x-axis, by protractor.
    fn read_angle(&mut self, link: LinkId) -> Angle {
        let in_world = self.stands_in_world(link);
        match self.pose_of(link) {
            Some(pose) if !in_world => self.board.angle_between(pose.own_along, pose.along),
            _ if in_world || self.has_axes_of_world(link) => {
                self.board.angle(crate::given::Given::exact(0.0))
            }
            _ => {
                let x = self.board.rightward();
                let nothing = self.no_direction(Missing::Pose(link));
                self.board.angle_between(x, nothing)
            }
        }
    }

    fn read_transmission(&mut self, i: LinkId, j: LinkId) -> Read {
        let [Some(pin), Some(p), Some(q)] = transmission_points(self.mechanism, i, j) else {
            return Read::Undefined("the links share no pin");
        };
        let coupler = self.outward(i, pin, p);
        let output = self.outward(j, pin, q);
        Read::Angle(self.board.unsigned_angle(coupler, output))
    }
}
