//! How a student's drawing lies on its sheet: a sheet that was turned as a whole shows everything rightly, against the
//! drawing itself; a polygon that is turned against its skeleton does not.

use super::case::{Found, ONE_SCALE, Target, polygon, size};
use crate::graphical::construction::{Construction, Label};
use crate::mechanism::quantity::Order;
use crate::mechanism::{Input, LinkId, Mechanism, PointId};

/// A turn that is smaller than this is how a sheet lies, and told of nobody: radians.
const LEVEL: f64 = 0.0145;
/// Two figures that are turned alike to this lie on one sheet, radians.
const ALIKE: f64 = 0.026;
/// A skeleton that is larger or smaller by no more than this part was drawn at the scale of the sheet.
const SAME_SCALE: f64 = 1.05;
/// What is shorter than this on paper (mm) does not tell how it is turned.
const SHORT: f64 = 6.0;
/// A point that lies, turned back, within this of its place (mm) was drawn rightly.
const NEAR: f64 = 0.8;
/// The same as a part of how far it is from where it is turned about.
const NEAR_PART: f64 = 0.014;
/// Without a skeleton a polygon that is turned by about a right angle or half a turn is drawn wrongly: nearer than this to
/// either (radians) nothing is taken for a turned sheet.
const CLEAR: f64 = 0.17;

/// By which angles a student's figures have to be turned back, radians.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Turns {
    /// The whole sheet.
    sheet: f64,
    /// The skeleton, which two fixed points lay down to the last minute.
    skeleton: Option<f64>,
    /// A polygon against the sheet.
    velocity: Option<f64>,
    acceleration: Option<f64>,
}

impl Turns {
    /// The angle by which every figure is turned back.
    pub(super) fn of_sheet(&self) -> f64 {
        self.sheet
    }

    /// The same of the skeleton.
    pub(super) fn of_skeleton(&self) -> f64 {
        self.skeleton.unwrap_or(self.sheet)
    }

    /// By how much a polygon is turned against the sheet beyond that, counter-clockwise as the student has it.
    pub(super) fn against_sheet(&self, order: Order) -> Option<f64> {
        match order {
            Order::Position => None,
            Order::Velocity => self.velocity,
            Order::Acceleration => self.acceleration,
        }
    }

    /// By how much the sheet lies turned, degrees counter-clockwise; `None` where it lies as it should.
    pub(super) fn told(&self) -> Option<f64> {
        (self.sheet.abs() > LEVEL).then(|| -self.sheet.to_degrees())
    }
}

/// A point of the student and its right place, from where the figure is turned about, mm.
type Pair = [[f64; 2]; 2];

/// How one figure is turned.
#[derive(Clone, Copy)]
struct Fitted {
    turn: f64,
    /// Whether more of it is right turned back than as it lies.
    better: bool,
}

/// How the figures of a student lie.
pub(super) fn turns(mechanism: &Mechanism, right: &Construction, figures: &[Found<'_>]) -> Turns {
    let of = |order: Order| figures.iter().find(|found| found.figure.order == order);
    let all: Vec<Pair> =
        figures.iter().filter_map(|found| driven_pairs(mechanism, right, found)).flatten().collect();
    // Fixed points tell how a sheet lies, as long as what hangs on no other of them does not lie better as it is.
    let believed = |turn: &f64| turn.abs() <= LEVEL || off(&all, *turn) <= off(&all, 0.0);
    let by_fixed = of(Order::Position).and_then(|found| laid_down(mechanism, right, found)).filter(believed);
    let fitted = |order: Order| fit(&pairs(mechanism, right, of(order)?)?);
    let [skeleton, velocity, acceleration] =
        [Order::Position, Order::Velocity, Order::Acceleration].map(fitted);
    let polygons = || [velocity, acceleration].into_iter().flatten();
    let level = Fitted { turn: 0.0, better: false };
    let sheet = match (by_fixed, skeleton) {
        // A skeleton says how the sheet lies; with one fixed point, if it is turned as a whole.
        (Some(turn), _) => turn,
        (None, Some(skeleton)) if skeleton.better && believed(&skeleton.turn) => skeleton.turn,
        (None, None) if of(Order::Position).is_none() => {
            // Without one the polygons do, where all of them are turned alike.
            let first =
                polygons().next().filter(|first| first.better && is_clear(first.turn)).unwrap_or(level);
            let alike = polygons().all(|other| (other.turn - first.turn).abs() <= ALIKE);
            if alike { first.turn } else { 0.0 }
        }
        _ => 0.0,
    };
    // What lies a little askew was laid on the scanner so, or drawn so: polygons are taken as they are.
    let on_sheet = if sheet.abs() > LEVEL { sheet } else { 0.0 };
    let against = |own: Option<Fitted>| {
        let own = own.filter(|own| own.better || on_sheet != 0.0)?;
        let apart = angle(own.turn - on_sheet);
        (apart.abs() > LEVEL).then_some(-apart)
    };
    Turns {
        sheet: on_sheet,
        skeleton: by_fixed,
        velocity: against(velocity),
        acceleration: against(acceleration),
    }
}

/// How many times larger than the sheet's a skeleton is drawn as a whole, where two fixed points tell that and the points
/// that hang on them lie better so, or with one of them those moving points that hang on it and others.
pub(super) fn enlarged(mechanism: &Mechanism, right: &Construction, found: &Found<'_>) -> Option<f64> {
    let Some([(from, to), (second, there)]) = two_fixed(mechanism, right, found) else {
        let pivot = found.points.iter().find_map(|(_, _, target)| match target {
            Target::Place(point) if mechanism.is_fixed(*point) => Some(*point),
            _ => None,
        })?;
        let hangs = |point: PointId| {
            let mut links = mechanism.moving().map(|link| &mechanism.link(link).points);
            links.any(|points| points.contains(&pivot) && points.contains(&point))
        };
        let like = as_a_whole(&pairs(mechanism, right, found)?)?;
        // A link that is laid off otherwise takes all with it that stands on it.
        let free = |target: Target| matches!(target, Target::Place(point) if !mechanism.is_fixed(point) && !hangs(point));
        let others = pairs_of(mechanism, right, found, free)?;
        let factor = size(&like);
        let is_own = libm::log(factor).abs() >= libm::log(SAME_SCALE);
        return (is_own && others.iter().any(|pair| is_like(pair, like))).then_some(factor);
    };
    let apart = |[ax, ay]: [f64; 2], [bx, by]: [f64; 2]| libm::hypot(bx - ax, by - ay);
    let factor = apart(from, second) / apart(to, there);
    if !(factor > 0.0 && factor.is_finite()) || libm::log(factor).abs() < libm::log(SAME_SCALE) {
        return None;
    }
    let turn = laid_down(mechanism, right, found)?;
    let moving = |target: Target| matches!(target, Target::Place(point) if !mechanism.is_fixed(point));
    let own = pairs_of(mechanism, right, found, moving)?;
    let back = |[own, right]: &Pair| [own.map(|mm| mm / factor), *right];
    let smaller: Vec<Pair> = own.iter().map(back).collect();
    (count_near(&smaller, turn) > count_near(&own, turn).max(count_near(&own, 0.0))).then_some(factor)
}

/// How many times larger than at the sheet's scale a polygon is drawn as a whole, turned or not. It begins with the images of
/// driven points: these are drawn at its scale if anything is.
pub(super) fn own_size(mechanism: &Mechanism, right: &Construction, found: &Found<'_>) -> Option<f64> {
    let like = as_a_whole(&pairs(mechanism, right, found)?)?;
    let driven = driven_pairs(mechanism, right, found)?;
    driven.iter().all(|pair| is_like(pair, like)).then(|| size(&like))
}

/// By what most points of a figure are turned and enlarged alike, as a complex number: two at least that are not one point,
/// and two of three, and more than lie as far away as at the sheet's scale.
fn as_a_whole(pairs: &[Pair]) -> Option<[f64; 2]> {
    let count = |like: [f64; 2]| pairs.iter().filter(|pair| is_like(pair, like)).count();
    let like = pairs.iter().map(ratio).max_by_key(|like| count(*like))?;
    let agreeing: Vec<&Pair> = pairs.iter().filter(|pair| is_like(pair, like)).collect();
    let at_the_sheets = pairs.iter().filter(|pair| (size(&ratio(pair)) - 1.0).abs() <= ONE_SCALE).count();
    let [x, y] = agreeing.iter().fold([0.0; 2], |[x, y], pair| {
        let [u, v] = ratio(pair);
        [x + u, y + v]
    });
    #[expect(clippy::cast_precision_loss, reason = "points are few")]
    let mean = [x, y].map(|sum| sum / agreeing.len().max(1) as f64);
    let is_whole = agreeing.len() >= 2
        && 3 * agreeing.len() >= 2 * pairs.len()
        && agreeing.len() > at_the_sheets
        && !one_line(&agreeing);
    is_whole.then_some(mean)
}

/// By what a point is turned and enlarged, as a complex number.
fn ratio([own, right]: &Pair) -> [f64; 2] {
    let square = right[0] * right[0] + right[1] * right[1];
    [(own[0] * right[0] + own[1] * right[1]) / square, (own[1] * right[0] - own[0] * right[1]) / square]
}

/// Whether a point is turned and enlarged so.
fn is_like(pair: &Pair, like: [f64; 2]) -> bool {
    let own = ratio(pair);
    size(&[own[0] - like[0], own[1] - like[1]]) <= ONE_SCALE * size(&like)
}

/// Whether a turn is no right angle and no half turn.
fn is_clear(turn: f64) -> bool {
    let quarter = std::f64::consts::FRAC_PI_2;
    let apart = libm::remainder(turn, quarter).abs();
    apart > CLEAR || turn.abs() < quarter / 2.0
}

fn angle(of: f64) -> f64 {
    libm::remainder(of, 2.0 * std::f64::consts::PI)
}

/// How two fixed points lay down a skeleton.
fn laid_down(mechanism: &Mechanism, right: &Construction, found: &Found<'_>) -> Option<f64> {
    let [(from, to), (second, there)] = two_fixed(mechanism, right, found)?;
    let along = |a: [f64; 2], b: [f64; 2]| libm::atan2(b[1] - a[1], b[0] - a[0]);
    Some(angle(along(to, there) - along(from, second)))
}

/// Two fixed points as a student has them, with their right places; `None` where they stand so near to each other that they
/// tell neither a turn nor a scale.
fn two_fixed(
    mechanism: &Mechanism,
    right: &Construction,
    found: &Found<'_>,
) -> Option<[([f64; 2], [f64; 2]); 2]> {
    let mut fixed = found.points.iter().filter_map(|(_, at, target)| match target {
        Target::Place(point) if mechanism.is_fixed(*point) => Some((*at, right.space.places[point.0]?)),
        _ => None,
    });
    let two = [fixed.next()?, fixed.next()?];
    let [([x, y], _), ([u, v], _)] = two;
    (size(&[u - x, v - y]) > SHORT).then_some(two)
}

fn pairs(mechanism: &Mechanism, right: &Construction, found: &Found<'_>) -> Option<Vec<Pair>> {
    pairs_of(mechanism, right, found, |_| true)
}

/// The same of the moving points of driven links alone.
fn driven_pairs(mechanism: &Mechanism, right: &Construction, found: &Found<'_>) -> Option<Vec<Pair>> {
    let driven = |point: PointId| {
        let mut inputs = mechanism.inputs.iter();
        !mechanism.is_fixed(point)
            && inputs.any(|input| match *input {
                Input::Angle { link, .. } | Input::Speed { link, .. } => {
                    mechanism.link(link).points.contains(&point)
                }
                Input::Slide { .. } => false,
            })
    };
    let own_link = |point: PointId, link: Option<LinkId>| {
        driven(point) && link.is_none_or(|link| mechanism.link(link).points.contains(&point))
    };
    pairs_of(mechanism, right, found, |target| match target {
        Target::Place(point) => driven(point),
        Target::Image(_, Label::Image { point, link }) => own_link(point, link),
        _ => false,
    })
}

fn pairs_of(
    mechanism: &Mechanism,
    right: &Construction,
    found: &Found<'_>,
    wanted: impl Fn(Target) -> bool,
) -> Option<Vec<Pair>> {
    let order = found.figure.order;
    let place = |target: Target| match target {
        Target::Image(_, Label::Pole) => Some([0.0; 2]),
        Target::Image(order, label) => {
            let images = &polygon(right, order)?.images;
            Some(images.iter().rev().find(|image| image.label == label)?.at)
        }
        Target::Place(point) => right.space.places[point.0],
        Target::Asked(_) | Target::Line(..) => None,
    };
    let turned_about = found.points.iter().find(|(_, _, target)| match target {
        Target::Image(_, label) => order != Order::Position && *label == Label::Pole,
        Target::Place(point) => mechanism.is_fixed(*point),
        Target::Asked(_) | Target::Line(..) => false,
    });
    let &(_, from, target) = turned_about?;
    let to = place(target)?;
    let pair = |&(_, at, target): &(&str, [f64; 2], Target)| {
        let there = place(target).filter(|_| wanted(target))?;
        let pair = [[at[0] - from[0], at[1] - from[1]], [there[0] - to[0], there[1] - to[1]]];
        pair.iter().all(|from| size(from) > SHORT).then_some(pair)
    };
    Some(found.points.iter().filter_map(pair).collect())
}

/// Whether a point comes to its place by a turn.
fn near(turn: f64) -> impl Fn(&&Pair) -> bool {
    let (sin, cos) = (libm::sin(turn), libm::cos(turn));
    move |[own, right]| {
        let at = [cos * own[0] - sin * own[1] - right[0], sin * own[0] + cos * own[1] - right[1]];
        size(&at) <= NEAR.max(NEAR_PART * size(right))
    }
}

/// How far points lie from their places after a turn: the sum of squares, mm², of which none counts for much.
fn off(pairs: &[Pair], turn: f64) -> f64 {
    let (sin, cos) = (libm::sin(turn), libm::cos(turn));
    let square = |[own, right]: &Pair| {
        let at = [cos * own[0] - sin * own[1] - right[0], sin * own[0] + cos * own[1] - right[1]];
        let away = size(&at).min(AWAY);
        away * away
    };
    pairs.iter().map(square).sum()
}

/// Farther away than this (mm) all places are alike wrong.
const AWAY: f64 = 2.0;

/// How many points come to their places by a turn.
fn count_near(pairs: &[Pair], turn: f64) -> usize {
    pairs.iter().filter(near(turn)).count()
}

/// The turn by which most points of a figure come to their places; `None` where two do not, or fewer than half.
fn fit(pairs: &[Pair]) -> Option<Fitted> {
    let between = |[own, right]: &Pair| {
        libm::atan2(own[0] * right[1] - own[1] * right[0], own[0] * right[0] + own[1] * right[1])
    };
    let count = |turn: f64| count_near(pairs, turn);
    let candidates = pairs.iter().map(between);
    let best = candidates.max_by(|a, b| count(*a).cmp(&count(*b)).then(b.abs().total_cmp(&a.abs())))?;
    let agreeing: Vec<&Pair> = pairs.iter().filter(near(best)).collect();
    if agreeing.len() < 2 || 2 * agreeing.len() < pairs.len() || one_line(&agreeing) {
        return None;
    }
    let [cross, dot] = agreeing.iter().fold([0.0, 0.0], |[cross, dot], [own, right]| {
        [cross + own[0] * right[1] - own[1] * right[0], dot + own[0] * right[0] + own[1] * right[1]]
    });
    Some(Fitted { turn: libm::atan2(cross, dot), better: agreeing.len() > count(0.0) })
}

/// Whether points are one place: that tells no more than one of them.
fn one_line(pairs: &[&Pair]) -> bool {
    let [first, ..] = pairs else { return true };
    let apart = |other: &&&Pair| {
        let [x, y] = [other[1][0] - first[1][0], other[1][1] - first[1][1]];
        libm::hypot(x, y) > SHORT
    };
    !pairs.iter().any(|pair| apart(&pair))
}
