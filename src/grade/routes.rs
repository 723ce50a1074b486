//! Other right ways to an answer than the one that the solution takes: from the student's own earlier vectors by the
//! polygon's sums, by proportion within a link's image, and by what a textbook calculates between reading and laying
//! off (V = ωl, Aⁿ = V²/l, Aᵗ = εl, 2ωV).
//!
//! Nothing is found to be right here. An answer that is wrong already is asked whether it follows from numbers of the
//! same student of which one at least is wrong.

use super::answers::Given;
use super::case::{Case, Room, Target, direction, polygon, size};
use super::change::Change;
use super::force_mistakes::same as same_force;
use super::judge::Verdict;
use super::mean_line::Cut;
use super::phrase::{Phrase, say};
use super::steps::{self, By};
use crate::graphical::Sketch;
use crate::graphical::construction::{Act, Acting, Calculation, Label, Reference};
use crate::mechanism::cycle::CycleQuantity;
use crate::mechanism::force::{Action, Force, Party, Share};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::{Direction, Input, LinkId, Mechanism, Path, PointId, Rider, Slide};

type Xy = [f64; 2];

/// Numbers, and whether a wrong answer is behind them.
#[derive(Debug, Clone, Copy)]
struct Own<T> {
    value: T,
    wrong: bool,
}

impl<T: Copy> Own<T> {
    fn known(value: T) -> Self {
        Self { value, wrong: false }
    }

    fn with<U: Copy, V>(self, other: Own<U>, make: impl Fn(T, U) -> V) -> Own<V> {
        Own { value: make(self.value, other.value), wrong: self.wrong || other.wrong }
    }

    fn map<V>(self, make: impl Fn(T) -> V) -> Own<V> {
        Own { value: make(self.value), wrong: self.wrong }
    }
}

/// Whether an answer follows rightly, by some way, from the student's other answers that were judged already, a wrong
/// one among them. `drawn` is what is known of the drawing, and `base` that drawing.
pub(super) fn follows(
    case: &Case<'_>,
    (drawn, base): (&Change, &Sketch),
    verdicts: &[Option<Verdict>],
    index: usize,
    (allowed, by): (Room, By),
) -> bool {
    let seen = &case.seen(base, drawn);
    let desk = Desk { case, base, seen, verdicts, index };
    let fits = |numbers: &[f64]| {
        let room = allowed.of_size(size(numbers), case.right_size(index));
        let room = Room { by: room.by * case.times_larger(index, Some(numbers)), ..room }
            .and(case.most(index, numbers));
        case.tells(index, numbers, room) && case.miss(index, Some(numbers), room) <= 1.0
    };
    desk.calculates(&fits) || !desk.is_settled() && steps::lead_to(case, drawn, verdicts, (index, by), &fits)
}

/// Whether a number of a turning-moment diagram follows from the student's own numbers of it, all of them right: a mean
/// within its room may move a small level by more than that has.
pub(super) fn follows_from_right_numbers(
    case: &Case<'_>,
    verdicts: &[Option<Verdict>],
    index: usize,
) -> bool {
    let Some(Quantity::Cycle(target)) = case.observations[index].quantity else { return false };
    let desk = Desk { case, base: &case.right, seen: &case.truth, verdicts, index };
    let room = case.rooms[index].times(OF_RIGHT);
    let fits = |own: &Own<f64>| !own.wrong && case.miss(index, Some(&[own.value]), room) <= 1.0;
    desk.of_cycle(target).iter().any(fits)
}

/// Where a centre would be found on one right line and on one through two centres that no third link has in common, with
/// what these are; the others are as the student has them.
pub(super) fn on_wrong_lines(case: &Case<'_>, base: &Sketch, index: usize) -> Vec<(Phrase, Xy)> {
    let Some(Quantity::Centre(i, j)) = case.observations[index].quantity else { return Vec::new() };
    let (seen, verdicts) = (&case.truth, &vec![Some(Verdict::Right); case.observations.len()]);
    Desk { case, base, seen, verdicts, index }.on_wrong_lines(i, j)
}

/// ω of a link as it stands in a drawing, given or calculated.
pub(super) fn omega_of(case: &Case<'_>, base: &Sketch, link: LinkId) -> Option<f64> {
    let given = case.mechanism.inputs.iter().find_map(|input| match *input {
        Input::Angle { link: of, omega, .. } if of == link => Some(omega.value),
        _ => None,
    });
    let acts = || base.construction.steps.iter().flat_map(|step| &step.acts);
    given.or_else(|| {
        acts().find_map(|act| match *act {
            Act::Calculate(Calculation::Omega { link: of, value, .. }) if of == link => Some(value),
            Act::Calculate(Calculation::Speed { link: of, omega, .. }) if of == link => Some(omega),
            _ => None,
        })
    })
}

/// What a coincident point under a rider stands for in a polygon; `None` of the rider itself.
fn under(mechanism: &Mechanism, order: Order, point: PointId, link: LinkId) -> Option<Quantity> {
    let guides = |slide: &Slide| {
        slide.guide.link == link && matches!(slide.rider, Rider::Pin { point: on, .. } if on == point)
    };
    let guided = mechanism.slides.iter().any(guides);
    match order {
        Order::Velocity if guided => Some(Quantity::CoincidentVelocity(point, link)),
        Order::Acceleration if guided => Some(Quantity::CoincidentAcceleration(point, link)),
        _ => None,
    }
}

/// What is open in a polygon: the rate of a link, or how far a rider slips along a guide of a link in this direction.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Open {
    Rate(LinkId),
    Slip(LinkId, Xy),
}

/// A way to the image of a joint: as far as it is known, and what is open of it, along which vectors.
struct Side {
    base: Own<Xy>,
    open: Vec<(Open, Xy)>,
}

/// The image of a joint at which two ways meet, and the two numbers that were open.
struct Closing {
    image: Own<Xy>,
    open: [(Open, Own<f64>); 2],
}

struct Desk<'d, 's> {
    case: &'d Case<'s>,
    base: &'d Sketch,
    seen: &'d [Option<Vec<f64>>],
    verdicts: &'d [Option<Verdict>],
    index: usize,
}

fn plus(a: Xy, b: Xy) -> Xy {
    [a[0] + b[0], a[1] + b[1]]
}

fn minus(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

fn times(a: Xy, b: f64) -> Xy {
    [a[0] * b, a[1] * b]
}

fn left(a: Xy) -> Xy {
    [-a[1], a[0]]
}

fn cross(a: Xy, b: Xy) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

impl Desk<'_, '_> {
    /// Whether a calculation from the student's own numbers leads to the answer.
    fn calculates(&self, fits: &dyn Fn(&[f64]) -> bool) -> bool {
        let observation = &self.case.observations[self.index];
        let target = match (observation.target, observation.quantity) {
            (Target::Image(order, Label::Image { point, link }), _) => {
                match self.represented(order, point, link) {
                    Some(quantity) => quantity,
                    None => return false,
                }
            }
            (Target::Asked(_), Some(quantity)) => quantity,
            _ => return false,
        };
        let vectors = self.vectors(target).into_iter().filter(|own| own.wrong).any(|own| fits(&own.value));
        vectors || self.scalars(target).into_iter().filter(|own| own.wrong).any(|own| fits(&[own.value]))
    }

    /// Whether the student's own numbers leave one value only: a normal part or Coriolis whose ω or V he handed in, an ω whose
    /// V, an ε whose tangential part.
    fn is_settled(&self) -> bool {
        let observation = &self.case.observations[self.index];
        let Some(target) = observation.quantity else { return false };
        if let Quantity::Omega(link) | Quantity::Alpha(link) = target {
            return self.turns_with_own_vector(target, link);
        }
        let product = matches!(
            target,
            Quantity::RelativeNormal(..)
                | Quantity::Normal(_)
                | Quantity::CoincidentNormal(..)
                | Quantity::Coriolis(..)
                | Quantity::Rub(..)
        );
        product && (!self.vectors(target).is_empty() || !self.scalars(target).is_empty())
    }

    /// Whether the student handed in a vector over whose arm a rate of a link is calculated, and that is no small one.
    fn turns_with_own_vector(&self, target: Quantity, link: LinkId) -> bool {
        let mechanism = &self.case.mechanism;
        let points = &mechanism.link(link).points;
        let seen = |wanted: Quantity| {
            let own = self.vector(wanted)?;
            Some(size(&own.value)).filter(|own| *own > 0.0)
        };
        let velocity = matches!(target, Quantity::Omega(_));
        for &to in points.iter().filter(|to| !mechanism.is_fixed(**to)) {
            for &from in points.iter().filter(|from| **from != to) {
                let relative = match velocity {
                    true => seen(Quantity::RelativeVelocity(to, from)),
                    false => seen(Quantity::RelativeTangential(to, from)),
                };
                let about_pivot = || match (mechanism.is_fixed(from), velocity) {
                    (false, _) => None,
                    (true, true) => seen(Quantity::Velocity(to)),
                    (true, false) => seen(Quantity::Tangential(to)),
                };
                if relative.or_else(about_pivot).is_some() {
                    return true;
                }
            }
        }
        let under = |slide: &Slide| match (slide.rider, slide.guide.link == link, self.pivot(link)) {
            (Rider::Pin { point, .. }, true, Some(_)) if velocity => {
                seen(Quantity::CoincidentVelocity(point, link)).is_some()
            }
            (Rider::Pin { point, .. }, true, Some(_)) => {
                seen(Quantity::CoincidentTangential(point, link)).is_some()
            }
            _ => false,
        };
        mechanism.slides.iter().any(under) || !velocity && self.tangential_left(link).is_some()
    }

    /// The tangential part of a point about the pivot of its link, as what its whole acceleration and its normal part leave,
    /// where that is clear of what both may be off.
    fn tangential_left(&self, link: LinkId) -> Option<(Own<Xy>, Xy)> {
        let pivot = self.pivot(link)?;
        self.case.mechanism.link(link).points.iter().filter(|point| **point != pivot).find_map(|&point| {
            let whole = self.vector(Quantity::Acceleration(point))?;
            let normal = self.vector(Quantity::Normal(point))?;
            let left = whole.with(normal, minus);
            let clear = size(&left.value) > CLEAR * size(&whole.value).max(size(&normal.value));
            Some((left, self.arm(pivot, point)?)).filter(|_| clear)
        })
    }

    /// What the image of a point stands for in a polygon: its own, whether the number of a link is told with it or not, or that
    /// of the point of another link under it.
    fn represented(&self, order: Order, point: PointId, link: Option<LinkId>) -> Option<Quantity> {
        match (link.filter(|link| !self.case.holds(*link, point)), order) {
            (Some(link), _) => under(&self.case.mechanism, order, point, link),
            (None, Order::Velocity) => Some(Quantity::Velocity(point)),
            (None, Order::Acceleration) => Some(Quantity::Acceleration(point)),
            (None, Order::Position) => None,
        }
    }

    /// What the student answered to another question, as numbers; a magnitude has the direction that it would have.
    fn numbers(&self, wanted: impl Fn(&Quantity, Target) -> bool) -> Option<Own<Vec<f64>>> {
        let judged = |index: usize| match self.verdicts[index] {
            Some(Verdict::Right) => Some(false),
            Some(Verdict::Wrong | Verdict::Consistent) => Some(true),
            _ => None,
        };
        self.case.observations.iter().enumerate().find_map(|(index, observation)| {
            let quantity = match (observation.target, observation.quantity) {
                (Target::Asked(_), Some(quantity)) => quantity,
                (Target::Image(order, Label::Image { point, link }), _) => {
                    self.represented(order, point, link)?
                }
                _ => return None,
            };
            if index == self.index || !wanted(&quantity, observation.target) {
                return None;
            }
            let wrong = judged(index)?;
            if wrong && self.case.hands_in_nothing(index) {
                return None;
            }
            let value = match observation.given {
                Given::Vector(vector) => vector.to_vec(),
                Given::Signed(value) => vec![value],
                Given::Magnitude(given) | Given::Drawn(given) => {
                    let seen = self.seen[index].as_deref()?;
                    let length = size(seen);
                    if length <= 0.0 {
                        return None;
                    }
                    seen.iter().map(|n| n / length * given).collect()
                }
            };
            Some(Own { value, wrong })
        })
    }

    fn vector(&self, quantity: Quantity) -> Option<Own<Xy>> {
        let still = |point: PointId| self.case.mechanism.is_fixed(point);
        let turned = match quantity {
            Quantity::Velocity(p) | Quantity::Acceleration(p) if still(p) => {
                return Some(Own::known([0.0; 2]));
            }
            Quantity::RelativeVelocity(a, b) => Some(Quantity::RelativeVelocity(b, a)),
            Quantity::RelativeAcceleration(a, b) => Some(Quantity::RelativeAcceleration(b, a)),
            Quantity::RelativeNormal(a, b) => Some(Quantity::RelativeNormal(b, a)),
            Quantity::RelativeTangential(a, b) => Some(Quantity::RelativeTangential(b, a)),
            _ => None,
        };
        let read = |wanted: Quantity| {
            let own = self.numbers(|quantity, _| *quantity == wanted)?;
            let [x, y] = own.value[..] else { return None };
            Some(Own { value: [x, y], wrong: own.wrong })
        };
        read(quantity).or_else(|| read(turned?).map(|own| own.map(|v| times(v, -1.0))))
    }

    fn scalar(&self, quantity: Quantity) -> Option<Own<f64>> {
        if let Some(own) = self.numbers(|known, _| *known == quantity) {
            let [value] = own.value[..] else { return None };
            return Some(Own { value, wrong: own.wrong });
        }
        let mut inputs = self.case.mechanism.inputs.iter();
        match quantity {
            Quantity::Omega(LinkId::FRAME) | Quantity::Alpha(LinkId::FRAME) => Some(Own::known(0.0)),
            Quantity::Omega(wanted) => inputs.find_map(|input| match *input {
                Input::Angle { link, omega, .. } if link == wanted => Some(Own::known(omega.value)),
                _ => None,
            }),
            Quantity::Alpha(wanted) => inputs.find_map(|input| match *input {
                Input::Angle { link, alpha, .. } | Input::Speed { link, alpha, .. } if link == wanted => {
                    Some(Own::known(alpha.value))
                }
                _ => None,
            }),
            _ => None,
        }
    }

    /// From one point to another, metres.
    fn arm(&self, from: PointId, to: PointId) -> Option<Xy> {
        let space = &self.base.construction.space;
        let [a, b] = [space.places[from.0]?, space.places[to.0]?];
        Some(times(minus(b, a), space.metres_per_mm)).filter(|arm| size(arm) > 0.0)
    }

    /// The moving links that have both points.
    fn links_of(&self, a: PointId, b: PointId) -> Vec<LinkId> {
        let mechanism = &self.case.mechanism;
        let both = |link: &LinkId| [a, b].iter().all(|p| mechanism.link(*link).points.contains(p));
        mechanism.moving().filter(both).collect()
    }

    /// The fixed point about which a link turns.
    fn pivot(&self, link: LinkId) -> Option<PointId> {
        let mechanism = &self.case.mechanism;
        mechanism.link(link).points.iter().copied().find(|p| mechanism.is_fixed(*p))
    }

    /// V of a point seen from another of its link, read or as a difference.
    fn relative(&self, to: PointId, from: PointId) -> Vec<Own<Xy>> {
        let read = self.vector(Quantity::RelativeVelocity(to, from));
        let ends = [to, from].map(|p| self.known_or_carried(Quantity::Velocity(p), p));
        let difference = match ends {
            [Some(to), Some(from)] => Some(to.with(from, minus)),
            _ => None,
        };
        read.into_iter().chain(difference).collect()
    }

    fn vectors(&self, target: Quantity) -> Vec<Own<Xy>> {
        let mut ways = self.sums(target);
        match target {
            Quantity::Velocity(p) | Quantity::Acceleration(p) => {
                ways.extend(self.images(target, p));
                ways.extend(self.carried(target, p));
                if let Quantity::Velocity(_) = target {
                    ways.extend(self.by_centres(p));
                }
                ways.extend(self.closings(target.order(), p).into_iter().map(|closing| closing.image));
            }
            Quantity::Slip(p, link) | Quantity::SlipAcceleration(p, link) => {
                let closings = self.closings(target.order(), p).into_iter().flat_map(|closing| closing.open);
                let slips = closings.filter_map(|(open, value)| match open {
                    Open::Slip(of, along) if of == link => Some(value.map(|value| times(along, value))),
                    _ => None,
                });
                ways.extend(slips);
            }
            Quantity::RelativeVelocity(to, from) => {
                for link in self.links_of(to, from) {
                    let turned = self.scalar(Quantity::Omega(link)).zip(self.arm(from, to));
                    ways.extend(turned.map(|(w, arm)| w.map(|w| times(left(arm), w))));
                }
            }
            Quantity::RelativeNormal(to, from) => ways.extend(self.normals(to, from)),
            Quantity::RelativeTangential(to, from) => ways.extend(self.tangentials(to, from)),
            Quantity::Normal(p) | Quantity::Tangential(p) => {
                for link in self.case.mechanism.moving() {
                    let Some(pivot) = self.pivot(link) else { continue };
                    if !self.case.mechanism.link(link).points.contains(&p) {
                        continue;
                    }
                    match target {
                        Quantity::Normal(_) => ways.extend(self.normals(p, pivot)),
                        _ => ways.extend(self.tangentials(p, pivot)),
                    }
                }
            }
            Quantity::CoincidentVelocity(p, link) | Quantity::CoincidentTangential(p, link) => {
                let rate = match target {
                    Quantity::CoincidentVelocity(..) => Quantity::Omega(link),
                    _ => Quantity::Alpha(link),
                };
                let arm = self.pivot(link).and_then(|pivot| self.arm(pivot, p));
                ways.extend(self.scalar(rate).zip(arm).map(|(r, arm)| r.map(|r| times(left(arm), r))));
            }
            Quantity::CoincidentNormal(p, link) => {
                let arm = self.pivot(link).and_then(|pivot| self.arm(pivot, p));
                let by_rate = self.scalar(Quantity::Omega(link)).zip(arm);
                ways.extend(by_rate.map(|(w, arm)| w.map(|w| times(arm, -w * w))));
                let by_speed = self.vector(Quantity::CoincidentVelocity(p, link)).zip(arm);
                ways.extend(by_speed.map(|(v, arm)| v.map(|v| toward_base(arm, size(&v)))));
            }
            Quantity::Centre(i, j) => {
                ways.extend(self.centres_in_line(i, j, Self::stated_centre));
                ways.extend(self.centres_in_line(i, j, Self::centre));
            }
            Quantity::Force(Force::Vector(action), Share::Total) => {
                ways.extend(self.own_force(action));
                ways.extend(self.closing_forces(action, &[]));
            }
            Quantity::Coriolis(p, link) => {
                let both = self.scalar(Quantity::Omega(link)).zip(self.vector(Quantity::Slip(p, link)));
                ways.extend(both.map(|(w, slip)| w.with(slip, |w, slip| times(left(slip), 2.0 * w))));
            }
            _ => {}
        }
        ways
    }

    /// What is known of a point: answered, or calculated from what is given alone.
    fn known(&self, quantity: Quantity, point: PointId) -> Option<Own<Xy>> {
        self.vector(quantity).or_else(|| {
            let order = quantity.order();
            let on_driven = |input: &Input| match *input {
                Input::Angle { link, .. } => self.case.mechanism.link(link).points.contains(&point),
                _ => false,
            };
            let driven = self.case.mechanism.inputs.iter().any(on_driven);
            let images = &polygon(&self.base.construction, order).filter(|_| driven)?.images;
            let own = |label: Label| match label {
                Label::Image { point: of, link } => {
                    of == point
                        && link.is_none_or(|link| self.case.mechanism.link(link).points.contains(&point))
                }
                _ => false,
            };
            let at = images.iter().rev().find(|image| own(image.label))?.at;
            Some(Own::known(times(at, self.case.si_per_mm(order))))
        })
    }

    /// The same, or carried by the rates of its link about a pivot of the frame.
    fn known_or_carried(&self, quantity: Quantity, point: PointId) -> Option<Own<Xy>> {
        let about_pivot = |link: LinkId| {
            let holds = self.case.mechanism.link(link).points.contains(&point);
            let pivot = self.pivot(link).filter(|_| holds)?;
            let arm = self.arm(pivot, point)?;
            match quantity.order() {
                Order::Velocity => {
                    Some(self.scalar(Quantity::Omega(link))?.map(|omega| times(left(arm), omega)))
                }
                _ => {
                    let normal = self.normal_of(link, pivot, point)?;
                    let turned = self.scalar(Quantity::Alpha(link))?.map(|alpha| times(left(arm), alpha));
                    Some(turned.with(normal, plus))
                }
            }
        };
        self.known(quantity, point).or_else(|| self.case.mechanism.moving().find_map(about_pivot))
    }

    /// Where the image of a point stands on the student's polygon, as far as that is known.
    fn stands(&self, order: Order, point: PointId) -> Option<Own<Xy>> {
        let label = Label::Image { point, link: None };
        let at = |sketch: &Sketch| -> Option<Xy> {
            let images = &polygon(&sketch.construction, order)?.images;
            Some(images.iter().rev().find(|image| image.label == label)?.at)
        };
        let own = at(self.base)?;
        let right = at(&self.case.right)?;
        let wrong = size(&minus(own, right)) > MOVED * size(&right);
        Some(Own { value: times(own, self.case.si_per_mm(order)), wrong })
    }

    /// ε of a link by the images of two of its points on the student's polygon.
    fn alpha_in_base(&self, link: LinkId) -> Option<Own<f64>> {
        let [from, to, ..] = self.case.mechanism.link(link).points[..] else { return None };
        let image = |point: PointId| match self.case.mechanism.is_fixed(point) {
            true => Some(Own::known([0.0; 2])),
            false => self.stands(Order::Acceleration, point),
        };
        let arm = self.arm(from, to)?;
        let square = arm[0] * arm[0] + arm[1] * arm[1];
        Some(image(to)?.with(image(from)?, |to, from| cross(arm, minus(to, from)) / square))
    }

    /// V of another point of the link and ω × l; A of it, ε × l and ω² l.
    fn carried(&self, target: Quantity, point: PointId) -> Vec<Own<Xy>> {
        let mut ways = Vec::new();
        for link in self.case.mechanism.moving() {
            let points = &self.case.mechanism.link(link).points;
            if !points.contains(&point) {
                continue;
            }
            let in_base = || omega_of(self.case, self.base, link).map(Own::known);
            let omega = self.scalar(Quantity::Omega(link));
            for &from in points.iter().filter(|from| **from != point) {
                let Some(arm) = self.arm(from, point) else { continue };
                match target {
                    Quantity::Velocity(_) => {
                        let both = self.known(Quantity::Velocity(from), from).zip(omega);
                        ways.extend(both.map(|(v, w)| v.with(w, |v, w| plus(v, times(left(arm), w)))));
                    }
                    _ => {
                        let known = self.known(Quantity::Acceleration(from), from);
                        let alpha = self.scalar(Quantity::Alpha(link)).or_else(|| self.alpha_in_base(link));
                        let rates = omega.or_else(in_base).zip(alpha);
                        ways.extend(known.zip(rates).map(|(a, (w, e))| {
                            let turned = w.with(e, |w, e| plus(times(left(arm), e), times(arm, -w * w)));
                            a.with(turned, plus)
                        }));
                    }
                }
            }
        }
        ways
    }

    /// V² / l from either end, or ω² l.
    fn normals(&self, to: PointId, from: PointId) -> Vec<Own<Xy>> {
        let Some(arm) = self.arm(from, to) else { return Vec::new() };
        let speeds = self.relative(to, from).into_iter().map(|v| v.map(|v| toward_base(arm, size(&v))));
        let links = self.links_of(to, from).into_iter();
        let rates = links.filter_map(|link| self.scalar(Quantity::Omega(link)));
        speeds.chain(rates.map(|w| w.map(|w| times(arm, -w * w)))).collect()
    }

    fn tangentials(&self, to: PointId, from: PointId) -> Vec<Own<Xy>> {
        let Some(arm) = self.arm(from, to) else { return Vec::new() };
        let rates = self.links_of(to, from).into_iter().filter_map(|link| self.scalar(Quantity::Alpha(link)));
        rates.map(|e| e.map(|e| times(left(arm), e))).collect()
    }

    /// By proportion from two other points of a link.
    fn images(&self, target: Quantity, point: PointId) -> Vec<Own<Xy>> {
        let of = |p: PointId| match target {
            Quantity::Velocity(_) => self.vector(Quantity::Velocity(p)),
            _ => self.vector(Quantity::Acceleration(p)),
        };
        let of = |p: PointId| of(p).or_else(|| self.stands(target.order(), p));
        let mut ways = self.images_of_guide(target, point);
        for link in self.case.mechanism.moving() {
            let points = &self.case.mechanism.link(link).points;
            if !points.contains(&point) {
                continue;
            }
            for (place, &a) in points.iter().enumerate() {
                for &b in &points[place + 1..] {
                    if a == point || b == point {
                        continue;
                    }
                    let (Some(base), Some(arm), Some(va), Some(vb)) =
                        (self.arm(a, b), self.arm(a, point), of(a), of(b))
                    else {
                        continue;
                    };
                    let square = base[0] * base[0] + base[1] * base[1];
                    let along = (arm[0] * base[0] + arm[1] * base[1]) / square;
                    let across = cross(base, arm) / square;
                    ways.push(va.with(vb, |va, vb| {
                        let d = minus(vb, va);
                        plus(va, plus(times(d, along), times(left(d), across)))
                    }));
                }
            }
        }
        ways
    }

    /// By proportion from the point of a guide that lies under its rider and another point of the guide's link: its pivot, or
    /// one of which the vector is known.
    fn images_of_guide(&self, target: Quantity, point: PointId) -> Vec<Own<Xy>> {
        let mechanism = &self.case.mechanism;
        let order = target.order();
        let whole = |point: PointId| match order {
            Order::Velocity => Quantity::Velocity(point),
            _ => Quantity::Acceleration(point),
        };
        let way = |slide: &Slide, from: PointId| {
            let (link, Rider::Pin { point: rider, .. }) = (slide.guide.link, slide.rider) else {
                return None;
            };
            let (base, arm) = (self.arm(from, rider)?, self.arm(from, point)?);
            let under = self.vector(under(mechanism, order, rider, link)?)?;
            let start = self.known(whole(from), from)?;
            let square = base[0] * base[0] + base[1] * base[1];
            let along = (arm[0] * base[0] + arm[1] * base[1]) / square;
            let across = cross(base, arm) / square;
            Some(start.with(under, |start, under| {
                let far = minus(under, start);
                plus(start, plus(times(far, along), times(left(far), across)))
            }))
        };
        let of_link = |slide: &Slide| {
            let points = &mechanism.link(slide.guide.link).points;
            let holds = points.contains(&point);
            points.iter().copied().filter(|from| holds && *from != point).collect::<Vec<PointId>>()
        };
        let slides = mechanism.slides.iter();
        slides.flat_map(|slide| of_link(slide).into_iter().filter_map(|from| way(slide, from))).collect()
    }

    /// By the sums of the polygons in which the answer stands: everything else in them is the student's own.
    fn sums(&self, target: Quantity) -> Vec<Own<Xy>> {
        let mut ways = Vec::new();
        for sum in self.relations(target) {
            let Some(&(_, sign)) = sum.iter().find(|(quantity, _)| *quantity == target) else { continue };
            let others: Option<Vec<(Own<Xy>, f64)>> = sum
                .iter()
                .filter(|(quantity, _)| *quantity != target)
                .map(|&(quantity, sign)| Some((self.vector(quantity).or_else(|| self.part(quantity))?, sign)))
                .collect();
            let Some(others) = others else { continue };
            let total = others.into_iter().fold(Own::known([0.0; 2]), |total, (own, sign)| {
                total.with(own, |total, v| plus(total, times(v, sign)))
            });
            ways.push(total.map(|total| times(total, -sign)));
        }
        ways
    }

    /// A part of an acceleration that was not handed in, from the ω and ε that were, and what is known of a driven point.
    fn part(&self, quantity: Quantity) -> Option<Own<Xy>> {
        let turned = |link: LinkId, arm: Option<Xy>, normal: bool| {
            let rate = if normal { Quantity::Omega(link) } else { Quantity::Alpha(link) };
            let arm = arm?;
            let part =
                move |rate: f64| if normal { times(arm, -rate * rate) } else { times(left(arm), rate) };
            Some(self.scalar(rate)?.map(part))
        };
        match quantity {
            Quantity::Velocity(point) | Quantity::Acceleration(point) => self.known(quantity, point),
            Quantity::CoincidentNormal(p, link) | Quantity::CoincidentTangential(p, link) => {
                let arm = self.pivot(link).and_then(|pivot| self.arm(pivot, p));
                turned(link, arm, matches!(quantity, Quantity::CoincidentNormal(..)))
            }
            Quantity::RelativeNormal(to, from) | Quantity::RelativeTangential(to, from) => {
                let normal = matches!(quantity, Quantity::RelativeNormal(..));
                let links = self.links_of(to, from).into_iter();
                links.filter_map(|link| turned(link, self.arm(from, to), normal)).next()
            }
            Quantity::Coriolis(p, link) => {
                let slip = self.vector(Quantity::Slip(p, link))?;
                let omega = self.scalar(Quantity::Omega(link))?;
                Some(omega.with(slip, |w, slip| times(left(slip), 2.0 * w)))
            }
            _ => None,
        }
    }

    /// Sums of vectors that are nothing, by the closed polygons of the textbook.
    fn relations(&self, target: Quantity) -> Vec<Vec<(Quantity, f64)>> {
        let answered = self.case.observations.iter().filter_map(|observation| observation.quantity);
        let mut sums: Vec<Vec<(Quantity, f64)>> = Vec::new();
        let mut add = |whole: Quantity, parts: &[Quantity]| {
            let sum: Vec<(Quantity, f64)> =
                [(whole, 1.0)].into_iter().chain(parts.iter().map(|part| (*part, -1.0))).collect();
            if sum.iter().any(|(quantity, _)| *quantity == target) && !sums.contains(&sum) {
                sums.push(sum);
            }
        };
        for quantity in answered.chain([target]) {
            match quantity {
                Quantity::RelativeVelocity(b, a) => {
                    add(Quantity::Velocity(b), &[Quantity::Velocity(a), quantity]);
                }
                Quantity::RelativeAcceleration(b, a)
                | Quantity::RelativeNormal(b, a)
                | Quantity::RelativeTangential(b, a) => {
                    let (whole, from) = (Quantity::Acceleration(b), Quantity::Acceleration(a));
                    let relative = Quantity::RelativeAcceleration(b, a);
                    let parts = [Quantity::RelativeNormal(b, a), Quantity::RelativeTangential(b, a)];
                    add(whole, &[from, relative]);
                    add(relative, &parts);
                    add(whole, &[from, parts[0], parts[1]]);
                }
                Quantity::Normal(b) | Quantity::Tangential(b) => {
                    add(Quantity::Acceleration(b), &[Quantity::Normal(b), Quantity::Tangential(b)]);
                }
                Quantity::Slip(p, l) | Quantity::CoincidentVelocity(p, l) => {
                    let parts = [Quantity::CoincidentVelocity(p, l), Quantity::Slip(p, l)];
                    add(Quantity::Velocity(p), &parts);
                }
                Quantity::SlipAcceleration(p, l)
                | Quantity::CoincidentAcceleration(p, l)
                | Quantity::CoincidentNormal(p, l)
                | Quantity::CoincidentTangential(p, l)
                | Quantity::Coriolis(p, l) => {
                    let under = Quantity::CoincidentAcceleration(p, l);
                    let parts = [Quantity::CoincidentNormal(p, l), Quantity::CoincidentTangential(p, l)];
                    let relative = [Quantity::SlipAcceleration(p, l), Quantity::Coriolis(p, l)];
                    add(under, &parts);
                    add(Quantity::Acceleration(p), &[under, relative[0], relative[1]]);
                    add(Quantity::Acceleration(p), &[parts[0], parts[1], relative[0], relative[1]]);
                }
                Quantity::SlipNormal(p, l) | Quantity::SlipTangential(p, l) => {
                    let parts = [Quantity::SlipNormal(p, l), Quantity::SlipTangential(p, l)];
                    add(Quantity::SlipAcceleration(p, l), &parts);
                }
                _ => {}
            }
        }
        sums
    }

    fn scalars(&self, target: Quantity) -> Vec<Own<f64>> {
        let two = |a: Quantity, b: Quantity| self.scalar(a).zip(self.scalar(b));
        match target {
            Quantity::Omega(link) => {
                let closed = self.closed_rates(target, link);
                [self.rates(target, link), self.rates_by_centres(link), closed].concat()
            }
            Quantity::Alpha(link) => [self.rates(target, link), self.closed_rates(target, link)].concat(),
            Quantity::RelativeOmega(i, j) => {
                let both = two(Quantity::Omega(i), Quantity::Omega(j));
                both.map(|(a, b)| a.with(b, |a, b| a - b)).into_iter().collect()
            }
            Quantity::RelativeAlpha(i, j) => {
                let both = two(Quantity::Alpha(i), Quantity::Alpha(j));
                both.map(|(a, b)| a.with(b, |a, b| a - b)).into_iter().collect()
            }
            Quantity::Ratio(i, j) | Quantity::Advantage(j, i) => {
                let both = two(Quantity::Omega(i), Quantity::Omega(j)).filter(|(_, b)| b.value != 0.0);
                both.map(|(a, b)| a.with(b, |a, b| a / b)).into_iter().collect()
            }
            Quantity::Rub(pin, i, j) => {
                let journal = self.case.mechanism.points.get(pin.0).and_then(|point| point.journal);
                let both = two(Quantity::Omega(i), Quantity::Omega(j)).zip(journal);
                let rubbing = both.map(|((a, b), radius)| a.with(b, |a, b| (a - b).abs() * radius.value));
                rubbing.into_iter().collect()
            }
            Quantity::Cycle(of) => self.of_cycle(of),
            _ => Vec::new(),
        }
    }

    // --- polygons that close at a joint ----------------------------------------------------------

    /// ω or ε of a link by every polygon that closes at one of its points; none where the vector is handed in over whose arm
    /// it is calculated.
    fn closed_rates(&self, target: Quantity, link: LinkId) -> Vec<Own<f64>> {
        if self.turns_with_own_vector(target, link) {
            return Vec::new();
        }
        let order = target.order();
        let points = (0..self.case.mechanism.points.len()).map(PointId);
        let open = points.flat_map(|point| self.closings(order, point)).flat_map(|closing| closing.open);
        open.filter_map(|(open, value)| matches!(open, Open::Rate(of) if of == link).then_some(value))
            .collect()
    }

    /// Where the two lines cross that lead to a joint from what is known on either side.
    fn closings(&self, order: Order, point: PointId) -> Vec<Closing> {
        let sides = self.sides(order, point);
        let mut closings = Vec::new();
        for (place, one) in sides.iter().enumerate() {
            for other in &sides[place + 1..] {
                let back = other.open.iter().map(|&(open, along)| (open, along, times(along, -1.0)));
                let lines: Vec<(Open, Xy, Xy)> =
                    one.open.iter().map(|&(open, along)| (open, along, along)).chain(back).collect();
                let [(first, from_one, d), (second, _, e)] = lines[..] else { continue };
                let sine = cross(d, e);
                if first == second || sine.abs() <= FLAT * size(&d) * size(&e) {
                    continue;
                }
                let lengths = one.base.with(other.base, |one, other| {
                    let gap = minus(one, other);
                    [-cross(gap, e) / sine, -cross(d, gap) / sine]
                });
                let [far, near] = [lengths.map(|[far, _]| far), lengths.map(|[_, near]| near)];
                let image = match one.open.len() {
                    0 => one.base,
                    1 => one.base.with(far, |base, far| plus(base, times(from_one, far))),
                    _ => other.base,
                };
                closings.push(Closing { image, open: [(first, far), (second, near)] });
            }
        }
        closings
    }

    /// All that leads to a joint: itself, the points of its links that are known, the guides on which it slides.
    fn sides(&self, order: Order, point: PointId) -> Vec<Side> {
        let whole = |point: PointId| match order {
            Order::Velocity => Quantity::Velocity(point),
            _ => Quantity::Acceleration(point),
        };
        let mechanism = &self.case.mechanism;
        let own = self.known(whole(point), point);
        let mut sides: Vec<Side> = own.map(|base| Side { base, open: Vec::new() }).into_iter().collect();
        for link in mechanism.moving() {
            let points = &mechanism.link(link).points;
            for &from in points.iter().filter(|from| points.contains(&point) && **from != point) {
                let (Some(arm), Some(base)) =
                    (self.arm(from, point), self.known_or_carried(whole(from), from))
                else {
                    continue;
                };
                let square = match order {
                    Order::Velocity => Some(Own::known([0.0; 2])),
                    _ => self.normal_of(link, from, point),
                };
                let Some(square) = square else { continue };
                sides.push(Side { base: base.with(square, plus), open: vec![(Open::Rate(link), left(arm))] });
            }
        }
        for (place, slide) in mechanism.slides.iter().enumerate() {
            let rides = matches!(slide.rider, Rider::Pin { point: on, .. } if on == point);
            let straight = matches!(slide.guide.path, Path::Straight { .. });
            let Some(along) = self.guide_direction(place).filter(|_| rides && straight) else { continue };
            let guide = slide.guide.link;
            let slip = (Open::Slip(guide, along), along);
            if guide == LinkId::FRAME {
                sides.push(Side { base: Own::known([0.0; 2]), open: vec![slip] });
                continue;
            }
            let Some((pivot, arm)) = self.pivot(guide).and_then(|p| Some((p, self.arm(p, point)?))) else {
                continue;
            };
            let base = match order {
                Order::Velocity => Some(Own::known([0.0; 2])),
                _ => {
                    let coriolis = Quantity::Coriolis(point, guide);
                    let coriolis = self.vector(coriolis).or_else(|| self.part(coriolis));
                    let under = self.vector(Quantity::CoincidentNormal(point, guide));
                    let normal = under.or_else(|| self.normal_of(guide, pivot, point));
                    coriolis.zip(normal).map(|(coriolis, normal)| coriolis.with(normal, plus))
                }
            };
            let turned = (Open::Rate(guide), left(arm));
            sides.extend(base.map(|base| Side { base, open: vec![turned, slip] }));
        }
        sides
    }

    /// The normal part of a point about another of its link: answered, or ω² l.
    fn normal_of(&self, link: LinkId, from: PointId, to: PointId) -> Option<Own<Xy>> {
        let about_pivot =
            self.case.mechanism.is_fixed(from).then(|| self.vector(Quantity::Normal(to))).flatten();
        self.vector(Quantity::RelativeNormal(to, from)).or(about_pivot).or_else(|| {
            let in_base = || omega_of(self.case, self.base, link).map(Own::known);
            let omega = self.scalar(Quantity::Omega(link)).or_else(in_base)?;
            let arm = self.arm(from, to)?;
            Some(omega.map(|omega| times(arm, -omega * omega)))
        })
    }

    // --- forces ----------------------------------------------------------------------------------

    /// A force between two links as it was answered, or its reaction.
    fn own_force(&self, action: Action) -> Option<Own<Xy>> {
        let answered = |action: Action| self.vector(Quantity::Force(Force::Vector(action), Share::Total));
        answered(action).or_else(|| match action {
            Action::Pair { by, on } => {
                answered(Action::Pair { by: on, on: by }).map(|own| own.map(|force| times(force, -1.0)))
            }
            _ => None,
        })
    }

    /// A force by the closed polygon of each body on which it stands, but for those that were cut free before: all others on
    /// it are given, the student's own, or found so.
    fn closing_forces(&self, action: Action, before: &[usize]) -> Vec<Own<Xy>> {
        let Some(sheet) = self.case.balance() else { return Vec::new() };
        let mut ways = Vec::new();
        for (place, body) in sheet.bodies.iter().enumerate().filter(|(place, _)| !before.contains(place)) {
            let Some(own) = body.acting.iter().find(|acting| same_force(acting.action, action)) else {
                continue;
            };
            let cut = [before, &[place]].concat();
            let others = body.acting.iter().filter(|acting| !same_force(acting.action, action));
            let others: Option<Vec<Own<Xy>>> = others.map(|acting| self.acts(acting, &cut)).collect();
            let sign = if own.action == action { -1.0 } else { 1.0 };
            ways.extend(others.map(|others| {
                let sum = others.into_iter().fold(Own::known([0.0; 2]), |sum, own| sum.with(own, plus));
                sum.map(|sum| times(sum, sign))
            }));
        }
        ways
    }

    /// A force on a body as the student has it.
    fn acts(&self, acting: &Acting, cut: &[usize]) -> Option<Own<Xy>> {
        let between = matches!(
            acting.action,
            Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..) | Action::Rolling { .. }
        );
        let given = (!between).then(|| Own::known(acting.force));
        self.own_force(acting.action)
            .or(given)
            .or_else(|| self.closing_forces(acting.action, cut).into_iter().next())
    }

    // --- instant centres -----------------------------------------------------------------------

    /// The centre of two links, answered, a joint of both, or found from such.
    fn centre(&self, one: LinkId, other: LinkId) -> Option<Own<Xy>> {
        self.stated_centre(one, other).or_else(|| {
            let found = self.centres_in_line(one, other, Self::stated_centre);
            found.iter().copied().find(|own| own.wrong).or(found.first().copied())
        })
    }

    fn stated_centre(&self, one: LinkId, other: LinkId) -> Option<Own<Xy>> {
        let centre = |a, b| self.vector(Quantity::Centre(a, b));
        let mechanism = &self.case.mechanism;
        let joint = || {
            let points = &mechanism.link(one).points;
            let shared = points.iter().find(|p| mechanism.link(other).points.contains(p))?;
            let at = self.base.construction.space.places[shared.0]?;
            Some(Own::known(times(at, self.case.si_per_mm(Order::Position))))
        };
        centre(one, other).or_else(|| centre(other, one)).or_else(joint)
    }

    /// Where two lines cross, each through two centres that three links have in common.
    fn centres_in_line(
        &self,
        i: LinkId,
        j: LinkId,
        centre: fn(&Self, LinkId, LinkId) -> Option<Own<Xy>>,
    ) -> Vec<Own<Xy>> {
        let mechanism = &self.case.mechanism;
        let third = [LinkId::FRAME].into_iter().chain(mechanism.moving()).filter(|k| *k != i && *k != j);
        let lines: Vec<Own<[Xy; 2]>> =
            third.filter_map(|k| self.line_of_centres([i, j, k], centre)).collect();
        let mut ways = Vec::new();
        for (place, one) in lines.iter().enumerate() {
            for other in &lines[place + 1..] {
                let meet =
                    one.with(*other, |[a, d], [b, e]| plus(a, times(d, cross(minus(b, a), e) / cross(d, e))));
                ways.extend(meet.value.iter().all(|x| x.is_finite()).then_some(meet));
            }
        }
        ways
    }

    /// See [`on_wrong_lines`].
    fn on_wrong_lines(&self, i: LinkId, j: LinkId) -> Vec<(Phrase, Xy)> {
        let mechanism = &self.case.mechanism;
        let third: Vec<LinkId> = [LinkId::FRAME]
            .into_iter()
            .chain(mechanism.moving())
            .filter(|link| *link != i && *link != j && !mechanism.link(*link).block)
            .collect();
        let right = third.iter().filter_map(|&k| self.line_of_centres([i, j, k], Self::stated_centre));
        let right: Vec<[Xy; 2]> = right.map(|line| line.value).collect();
        let mut found: Vec<(Phrase, Xy)> = Vec::new();
        for (&k, &l) in third.iter().flat_map(|k| third.iter().map(move |l| (k, l))) {
            let (Some(a), Some(b)) = (self.stated_centre(i, k), self.stated_centre(l, j)) else { continue };
            if k == l {
                continue;
            }
            let [a, b] = [a.value, b.value];
            let name = |a: LinkId, b: LinkId| self.case.named(&Quantity::Centre(a.min(b), a.max(b)));
            let how = say!("the line through {} and {}", name(i, k), name(l, j));
            let along = minus(b, a);
            for &[base, direction] in &right {
                let sine = cross(direction, along);
                if sine.abs() > FLAT * size(&direction) * size(&along) {
                    let far = cross(minus(a, base), along) / sine;
                    found.push((how.clone(), plus(base, times(direction, far))));
                }
            }
        }
        found
    }

    /// A point and the direction of the line on which the centre of two links lies with those that a third one shares with
    /// them; what only slides on another has its centre square to the guide at infinity.
    fn line_of_centres(
        &self,
        [i, j, k]: [LinkId; 3],
        centre: fn(&Self, LinkId, LinkId) -> Option<Own<Xy>>,
    ) -> Option<Own<[Xy; 2]>> {
        match (centre(self, i, k), centre(self, k, j)) {
            (Some(a), Some(b)) => Some(a.with(b, |a, b| [a, minus(b, a)])),
            (Some(a), None) => self.square_to_guide(k, j).map(|d| a.map(|a| [a, d])),
            (None, Some(b)) => self.square_to_guide(i, k).map(|d| b.map(|b| [b, d])),
            (None, None) => None,
        }
    }

    /// The direction of the centre of two links of which one only slides on the other.
    fn square_to_guide(&self, one: LinkId, other: LinkId) -> Option<Xy> {
        let mechanism = &self.case.mechanism;
        let place = mechanism.slides.iter().position(|slide| {
            let links = [Party::Link(slide.guide.link), mechanism.party_of(&slide.rider)];
            [one, other].iter().all(|link| links.contains(&Party::Link(*link)))
        })?;
        self.guide_direction(place).map(left)
    }

    /// The direction of a straight guide, as it is stated or drawn.
    fn guide_direction(&self, place: usize) -> Option<Xy> {
        let guide = self.case.mechanism.slides.get(place)?.guide;
        let stated = match guide.path {
            Path::Straight { direction: Direction::Angle(angle), turned, .. }
                if guide.link == LinkId::FRAME =>
            {
                let angle = angle.value + turned.value;
                Some([libm::cos(angle), libm::sin(angle)])
            }
            _ => None,
        };
        // On the student's polygon a line may be drawn square to the guide that should be along it.
        let right = &self.case.right.construction;
        let same = self.base.construction.space.places == right.space.places;
        let drawn = if same { right } else { &self.base.construction };
        stated.or_else(|| direction(drawn, Reference::Guide(place)))
    }

    /// Of each other link whose ω is known: that, its pole, and the centre that it shares with this link.
    fn shared_centres(&self, link: LinkId) -> Vec<(Own<f64>, Own<Xy>, Own<Xy>)> {
        let others = self.case.mechanism.moving().filter(|other| *other != link);
        let known = |other: LinkId| {
            let rate = self.scalar(Quantity::Omega(other))?;
            Some((rate, self.centre(LinkId::FRAME, other)?, self.centre(other, link)?))
        };
        others.filter_map(known).collect()
    }

    /// V of a point by the rotation of its link about its pole, or, where the link only slides, as that of the centre that
    /// it shares with another.
    fn by_centres(&self, point: PointId) -> Vec<Own<Xy>> {
        let mechanism = &self.case.mechanism;
        let Some(at) = self.base.construction.space.places[point.0] else { return Vec::new() };
        let at = times(at, self.case.si_per_mm(Order::Position));
        let turned = |rate: Own<f64>, about: Own<Xy>, at: Xy| {
            rate.with(about, move |rate, about| times(left(minus(at, about)), rate))
        };
        let mut ways = Vec::new();
        for link in mechanism.moving().filter(|link| mechanism.link(*link).points.contains(&point)) {
            let pole = self.centre(LinkId::FRAME, link);
            let own = self.scalar(Quantity::Omega(link)).into_iter();
            let rates: Vec<Own<f64>> = own.chain(self.rates_by_centres(link)).collect();
            ways.extend(pole.iter().flat_map(|pole| rates.iter().map(|rate| turned(*rate, *pole, at))));
            for (rate, pole, shared) in self.shared_centres(link) {
                let carried = rate.with(pole, |rate, pole| (rate, pole));
                let speed =
                    carried.with(shared, |(rate, pole), shared| times(left(minus(shared, pole)), rate));
                // It has the direction of the guide on which the link slides.
                let slides = mechanism.slides.iter().any(|slide| {
                    slide.guide.link == LinkId::FRAME && mechanism.party_of(&slide.rider) == Party::Link(link)
                        || matches!(slide.rider, Rider::Pin { point: on, .. } if on == point)
                });
                ways.extend(slides.then_some(speed));
            }
        }
        ways
    }

    /// ω by the distances of the centre that a link shares with another from the poles of both.
    fn rates_by_centres(&self, link: LinkId) -> Vec<Own<f64>> {
        let Some(pole) = self.centre(LinkId::FRAME, link) else { return Vec::new() };
        // V over the distance, as the book has it, or V square to the distance: of a centre that is wrong they differ.
        let ratio = |(rate, other, shared): (Own<f64>, Own<Xy>, Own<Xy>)| {
            let speed = rate.with(other, |rate, other| (rate, other));
            let speed =
                speed.with(shared, |(rate, other), shared| (times(minus(shared, other), rate), shared));
            let over = |whole: bool| {
                speed.with(pole, |(speed, shared), pole| {
                    let arm = minus(shared, pole);
                    let across = (speed[0] * arm[0] + speed[1] * arm[1]) / size(&arm);
                    let across = if whole { size(&speed).copysign(across) } else { across };
                    across / size(&arm)
                })
            };
            [over(true), over(false)]
        };
        self.shared_centres(link).into_iter().flat_map(ratio).filter(|own| own.value.is_finite()).collect()
    }

    /// What is reckoned from other numbers of a turning-moment diagram and what is given of it.
    fn of_cycle(&self, target: CycleQuantity) -> Vec<Own<f64>> {
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return Vec::new() };
        let own = |of: CycleQuantity| self.scalar(Quantity::Cycle(of));
        let (omega, period) = (cycle.omega.value.abs(), cycle.period.value);
        let inertia = || own(CycleQuantity::Inertia).unwrap_or(Own::known(self.case.rotating));
        let work =
            || own(CycleQuantity::Work).or_else(|| Some(own(CycleQuantity::Mean)?.map(|m| m * period)));
        let ways = match target {
            CycleQuantity::Power => vec![
                own(CycleQuantity::Mean).map(|mean| mean.map(|mean| mean * omega)),
                own(CycleQuantity::Work).map(|work| work.map(|work| work / period * omega)),
            ],
            CycleQuantity::Mean => vec![
                own(CycleQuantity::Work).map(|work| work.map(|work| work / period)),
                own(CycleQuantity::Power).map(|power| power.map(|power| power / omega)),
            ],
            CycleQuantity::Work => vec![work()],
            CycleQuantity::Fluctuation => {
                let levels = own(CycleQuantity::Highest).zip(own(CycleQuantity::Lowest));
                vec![levels.map(|(high, low)| high.with(low, |high, low| high - low))]
            }
            CycleQuantity::OfEnergy => {
                let both = own(CycleQuantity::Fluctuation).zip(work());
                vec![both.map(|(ef, work)| ef.with(work, |ef, work| ef / work))]
            }
            CycleQuantity::OfSpeed => vec![
                own(CycleQuantity::Fluctuation)
                    .map(|ef| ef.with(inertia(), |ef, inertia| ef / (inertia * omega * omega))),
            ],
            CycleQuantity::Flywheel => {
                let both = own(CycleQuantity::Fluctuation).zip(cycle.fluctuation);
                vec![both.map(|(ef, ks)| {
                    ef.with(inertia(), |ef, inertia| ef / (ks.value * omega * omega) - inertia)
                })]
            }
            _ => Vec::new(),
        };
        let by_mean = self.on_own_mean_line(target);
        ways.into_iter().flatten().chain(by_mean).filter(|own| own.value.is_finite()).collect()
    }

    /// What the given curve tells, cut at the student's own mean: only where the right mean leads to the right number.
    fn on_own_mean_line(&self, target: CycleQuantity) -> Option<Own<f64>> {
        let sheet = self.case.cycle.as_ref()?;
        let &[right] = self.case.truth[self.index].as_deref()? else { return None };
        let mean = sheet.curves[sheet.constant?].first()?[1];
        let read = |mean: f64| Cut::new(sheet, mean)?.number(target);
        if (read(mean)? - right).abs() > SAME_CUT * right.abs().max(self.case.rooms[self.index].by) {
            return None;
        }
        let own = self.scalar(Quantity::Cycle(CycleQuantity::Mean)).or_else(|| {
            let period = sheet.period;
            Some(self.scalar(Quantity::Cycle(CycleQuantity::Work))?.map(|work| work / period))
        })?;
        // Of a resisting torque the mean has its sign in the diagram.
        let value = read(if mean < 0.0 { -own.value.abs() } else { own.value })?;
        Some(Own { value, wrong: own.wrong })
    }

    /// ω = V / l or ε = Aᵗ / l by any two points of the link.
    fn rates(&self, target: Quantity, link: LinkId) -> Vec<Own<f64>> {
        let mut ways = Vec::new();
        let points = &self.case.mechanism.link(link).points;
        let rate = |arm: Xy, v: Xy| size(&v) / size(&arm) * if cross(arm, v) < 0.0 { -1.0 } else { 1.0 };
        for &from in points {
            for &to in points {
                let Some(arm) = self.arm(from, to).filter(|_| from != to) else { continue };
                let read: Vec<Own<Xy>> = match target {
                    Quantity::Omega(_) => self.relative(to, from),
                    _ => {
                        let pivoted = self.case.mechanism.is_fixed(from);
                        let own = pivoted.then(|| self.vector(Quantity::Tangential(to))).flatten();
                        let relative = self.vector(Quantity::RelativeTangential(to, from));
                        relative.into_iter().chain(own).collect()
                    }
                };
                ways.extend(read.into_iter().map(|v| v.map(|v| rate(arm, v))));
            }
        }
        if let Some(pivot) = self.pivot(link) {
            for slide in &self.case.mechanism.slides {
                let Rider::Pin { point, .. } = slide.rider else { continue };
                let (Some(arm), true) = (self.arm(pivot, point), slide.guide.link == link) else { continue };
                let under = match target {
                    Quantity::Omega(_) => Quantity::CoincidentVelocity(point, link),
                    _ => Quantity::CoincidentTangential(point, link),
                };
                ways.extend(self.vector(under).map(|v| v.map(|v| rate(arm, v))));
            }
        }
        if let (Quantity::Alpha(_), Some((left, arm))) = (target, self.tangential_left(link)) {
            ways.push(left.map(|left| rate(arm, left)));
        }
        ways
    }
}

/// What is left of two vectors tells a rate where it is no smaller part of the longer one.
const CLEAR: f64 = 0.5;

/// An image that stands farther from where it should, as a part of its distance from the pole, is another one.
const MOVED: f64 = 1e-6;

/// A number that follows from right ones is met within this part of its room.
const OF_RIGHT: f64 = 0.5;

/// A curve of straight pieces leads to a number of the diagram within this part.
const SAME_CUT: f64 = 0.02;

/// The sine of the flattest crossing at which a pencil still finds a point.
const FLAT: f64 = 0.05;

/// V² / l toward the base of an arm.
fn toward_base(arm: Xy, speed: f64) -> Xy {
    let square = arm[0] * arm[0] + arm[1] * arm[1];
    times(arm, -speed * speed / square)
}
