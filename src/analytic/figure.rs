//! Places that the scene states by two loci: both loci as equations of circles or lines, solved together.
//!
//! Every locus is `a |X|² + b·X + c = 0` about a point of its own (`a = 0` is a line; the circle from which a segment
//! is seen at an angle follows from the tangent of that angle, without its centre). Two such equations have a line in
//! common, which meets either of them in at most two points; Newton's iteration on both polishes what is found.

use std::borrow::Cow;

use super::AnalyticError;
use super::model::size;
use super::tape::U;
use crate::mechanism::statement::{Locus, Standing, Statement};
use crate::mechanism::{Direction, Given, GivenPoint, GuidePoint, Mechanism, Path, PointId};

/// A stated place may differ from a given dimension or guide by this part of the mechanism's size.
const ROUNDING: f64 = 1e-6;
/// A bound of first order holds where what is left out is this part of it at most: where the angle at which two curves cross
/// is known to this part.
const CURVED: f64 = 0.125;
/// The bound of first order is doubled for what is left out.
const SAFETY: f64 = 2.0;
/// Hints that differ by less than this part do not choose.
const TIE: f64 = 1e-9;

type Xy = [f64; 2];

fn minus(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Xy, b: Xy) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

fn length(a: Xy) -> f64 {
    libm::hypot(a[0], a[1])
}

fn left_of(a: Xy) -> Xy {
    [-a[1], a[0]]
}

fn at_angle(radians: f64) -> Xy {
    let (sin, cos) = libm::sincos(radians);
    [cos, sin]
}

/// A place and how far the true one may be away, metres.
#[derive(Debug, Clone, Copy)]
struct Spot {
    at: Xy,
    error: f64,
}

impl Spot {
    fn of(place: GivenPoint) -> Self {
        Self { at: place.map(|c| c.value), error: place[0].error + place[1].error }
    }

    fn given(self) -> GivenPoint {
        self.at.map(|value| Given::within(value, self.error))
    }
}

/// A direction, and how far it may be turned from the true one, radians.
#[derive(Debug, Clone, Copy)]
struct Bearing {
    unit: Xy,
    swing: f64,
}

/// `a |X|² + b·X + c = 0`, X counted from `about`.
#[derive(Debug, Clone, Copy)]
struct Curve {
    about: Xy,
    a: f64,
    b: Xy,
    c: f64,
    /// How far the curve may lie from the true one: as a whole, metres, and by being turned about `about`, radians.
    error: f64,
    swing: f64,
}

impl Curve {
    fn circle(centre: Spot, radius: Given) -> Self {
        let r = radius.value;
        let error = centre.error + radius.error;
        Self { about: centre.at, a: 1.0, b: [0.0; 2], c: -r * r, error, swing: 0.0 }
    }

    fn line(through: Spot, along: Bearing) -> Self {
        let swing = along.swing;
        Self { about: through.at, a: 0.0, b: left_of(along.unit), c: 0.0, error: through.error, swing }
    }

    /// The circle through both ends of a segment from which it is seen at an angle: the tangent of the angle between
    /// the directions to the ends is cross product over dot product.
    fn sees(ends: [Spot; 2], angle: Given) -> Self {
        let d = minus(ends[1].at, ends[0].at);
        let (sin, cos) = libm::sincos(angle.value);
        let b = [d[0] * sin - d[1] * cos, d[1] * sin + d[0] * cos];
        // Radius d / (2 sin): by the ends, and by the angle.
        let radius = length(d) / (2.0 * sin.abs());
        let error = (ends[0].error + ends[1].error) * (1.0 + 1.0 / sin.abs())
            + 2.0 * radius * angle.error * (cos / sin).abs()
            + radius * angle.error;
        Self { about: ends[0].at, a: -sin, b, c: 0.0, error, swing: 0.0 }
    }

    /// The same curve about another point.
    fn moved(&self, about: Xy) -> Self {
        let s = minus(self.about, about);
        let b = [self.b[0] - 2.0 * self.a * s[0], self.b[1] - 2.0 * self.a * s[1]];
        Self { about, b, c: self.c + self.a * dot(s, s) - dot(self.b, s), ..*self }
    }

    /// Distance by first order, with its gradient's unit vector; `None` at the centre.
    fn miss(&self, p: Xy) -> Option<(f64, Xy)> {
        let x = minus(p, self.about);
        let gradient = [2.0 * self.a * x[0] + self.b[0], 2.0 * self.a * x[1] + self.b[1]];
        let steep = length(gradient);
        let value = self.a * dot(x, x) + dot(self.b, x) + self.c;
        (steep > 0.0).then(|| (value / steep, gradient.map(|g| g / steep)))
    }

    /// Radius of curvature, metres; none of a line.
    fn curvature(&self) -> f64 {
        let steep = dot(self.b, self.b) - 4.0 * self.a * self.c;
        if self.a == 0.0 { 0.0 } else { 2.0 * self.a.abs() / steep.max(0.0).sqrt() }
    }

    /// How far the curve near a point may be from the true one, with the rounding of [`Self::miss`].
    fn error_at(&self, p: Xy) -> f64 {
        let x = minus(p, self.about);
        let coordinates = p.iter().chain(&self.about).map(|c| c.abs()).sum::<f64>();
        // The terms of the equation against its gradient: each is computed with a few roundings.
        let steep = libm::hypot(2.0 * self.a * x[0] + self.b[0], 2.0 * self.a * x[1] + self.b[1]);
        let terms =
            self.a.abs() * dot(x, x) + (self.b[0] * x[0]).abs() + (self.b[1] * x[1]).abs() + self.c.abs();
        let rounding = if steep > 0.0 { 16.0 * U * terms / steep } else { f64::INFINITY };
        self.error + self.swing * length(x) + rounding + 4.0 * U * coordinates
    }
}

/// Where two curves meet, roughly: no, one or two points. `None` where they are one curve, or concentric.
fn meets(first: &Curve, second: &Curve) -> Option<Vec<Xy>> {
    let other = second.moved(first.about);
    let (round, line) = if first.a == 0.0 && other.a == 0.0 {
        let determinant = cross(first.b, other.b);
        if determinant == 0.0 {
            return None;
        }
        let x = [
            (first.b[1] * other.c - other.b[1] * first.c) / determinant,
            (other.b[0] * first.c - first.b[0] * other.c) / determinant,
        ];
        return Some(vec![[first.about[0] + x[0], first.about[1] + x[1]]]);
    } else if other.a == 0.0 {
        (first, other)
    } else {
        // What both equations have in common is linear.
        let b = [0, 1].map(|i| first.a * other.b[i] - other.a * first.b[i]);
        let c = first.a * other.c - other.a * first.c;
        let line = Curve { a: 0.0, b, c, ..other };
        if first.a == 0.0 { (&other, *first) } else { (first, line) }
    };
    let square = dot(line.b, line.b);
    if square == 0.0 {
        return None;
    }
    let foot = line.b.map(|b| -line.c * b / square);
    let along = left_of(line.b).map(|b| b / square.sqrt());
    // a λ² + 2 h λ + k = 0 on that line.
    let h = round.a * dot(foot, along) + dot(round.b, along) / 2.0;
    let k = round.a * dot(foot, foot) + dot(round.b, foot) + round.c;
    let discriminant = h * h - round.a * k;
    if discriminant < 0.0 {
        return Some(Vec::new());
    }
    let q = -(h + libm::copysign(discriminant.sqrt(), h));
    let roots = if q == 0.0 { vec![0.0] } else { vec![q / round.a, k / q] };
    let place = |at: f64| [0, 1].map(|i| first.about[i] + foot[i] + at * along[i]);
    Some(roots.into_iter().map(place).collect())
}

/// Where the axes of the world cross.
const WORLD: [f64; 2] = [0.0; 2];

/// The mechanism with its stated places solved for.
pub(super) fn standing(mechanism: &Mechanism) -> Result<Cow<'_, Mechanism>, AnalyticError> {
    if mechanism.statements.is_empty() {
        return Ok(Cow::Borrowed(mechanism));
    }
    let mut figure = Figure {
        mechanism,
        spots: mechanism.points.iter().map(|p| p.place.exact().map(Spot::of)).collect(),
        size: 0.0,
    };
    // Where nothing is given yet sizes count from the world's axes, by which loci may be told.
    let first = figure.spots.iter().flatten().next().map(|spot| spot.at);
    let reference = match first {
        Some(at) => at,
        None => WORLD,
    };
    figure.size = size(mechanism, reference, &|_| true, &|_| true);
    for statement in &mechanism.statements {
        let spot = figure.place(statement)?;
        if let Some(slot) = figure.spots.get_mut(statement.point.0) {
            *slot = Some(spot);
        }
    }
    let spots = figure.spots;
    Ok(Cow::Owned(mechanism.with_places(|statement| spots[statement.point.0].map(Spot::given))))
}

/// What stands so far.
struct Figure<'m> {
    mechanism: &'m Mechanism,
    spots: Vec<Option<Spot>>,
    /// The largest length, metres.
    size: f64,
}

impl Figure<'_> {
    fn name(&self, point: PointId) -> String {
        self.mechanism.points.get(point.0).map_or_else(String::new, |p| p.name.clone())
    }

    fn fault(&self, point: PointId, why: impl Into<String>) -> AnalyticError {
        AnalyticError::Unplaced { point: self.name(point), why: why.into() }
    }

    fn spot(&self, of: PointId, asked: PointId) -> Result<Spot, AnalyticError> {
        let found = self.spots.get(asked.0).copied().flatten();
        found.ok_or_else(|| self.fault(of, format!("{} does not stand before it", self.name(asked))))
    }

    fn toward(&self, of: PointId, from: Spot, to: Spot) -> Result<Bearing, AnalyticError> {
        let line = minus(to.at, from.at);
        let far = length(line);
        let error = from.error + to.error;
        if far <= 2.0 * error {
            return Err(self.fault(of, "two points of a line lie in one place"));
        }
        let swing = error / (far - error) + 4.0 * U;
        Ok(Bearing { unit: line.map(|c| c / far), swing })
    }

    /// A point of a path that stands in the world.
    fn path_point(&self, of: PointId, point: GuidePoint) -> Result<Spot, AnalyticError> {
        match point {
            GuidePoint::Point(point) => self.spot(of, point),
            GuidePoint::Own(world) => Ok(Spot::of(world)),
        }
    }

    fn path(&self, of: PointId, path: &Path) -> Result<Curve, AnalyticError> {
        match *path {
            Path::Arc { centre, radius } => Ok(Curve::circle(self.path_point(of, centre)?, radius)),
            Path::Straight { through, direction, turned, offset } => {
                let through = self.path_point(of, through)?;
                let base = match direction {
                    Direction::Angle(angle) => Bearing { unit: at_angle(angle.value), swing: angle.error },
                    Direction::Toward(point) => self.toward(of, through, self.spot(of, point)?)?,
                };
                let [cos, sin] = at_angle(turned.value);
                let [x, y] = base.unit;
                let unit = [x * cos - y * sin, x * sin + y * cos];
                let swing = base.swing + turned.error + 4.0 * U;
                let left = left_of(unit);
                let at = [0, 1].map(|i| through.at[i] + left[i] * offset.value);
                let error = through.error + offset.error + swing * offset.value.abs();
                Ok(Curve::line(Spot { at, error }, Bearing { unit, swing }))
            }
        }
    }

    fn curve(&self, of: PointId, locus: &Locus) -> Result<Curve, AnalyticError> {
        Ok(match locus {
            Locus::Circle { centre, radius } => Curve::circle(self.spot(of, *centre)?, *radius),
            Locus::Ray { from, direction } => {
                let along = Bearing { unit: at_angle(direction.value), swing: direction.error + 2.0 * U };
                Curve::line(self.spot(of, *from)?, along)
            }
            Locus::Square { through, to: [from, to] } => {
                let along = self.toward(of, self.spot(of, *from)?, self.spot(of, *to)?)?;
                Curve::line(self.spot(of, *through)?, Bearing { unit: left_of(along.unit), ..along })
            }
            Locus::Sees { ends, angle } => {
                let ends = [self.spot(of, ends[0])?, self.spot(of, ends[1])?];
                self.toward(of, ends[0], ends[1])?;
                Curve::sees(ends, *angle)
            }
            Locus::On(path) => self.path(of, path)?,
        })
    }

    /// Whether a point of the curve of a locus is on the locus: ahead on a ray, on the arc of an angle.
    fn holds(&self, of: PointId, locus: &Locus, at: Xy) -> Result<bool, AnalyticError> {
        Ok(match locus {
            Locus::Ray { from, direction } => {
                dot(minus(at, self.spot(of, *from)?.at), at_angle(direction.value)) > 0.0
            }
            Locus::Sees { ends, angle } if !locus.is_whole() => {
                let [p, q] =
                    [self.spot(of, ends[0])?.at, self.spot(of, ends[1])?.at].map(|end| minus(end, at));
                let [cos, sin] = at_angle(angle.value);
                cross(p, q) * sin + dot(p, q) * cos > 0.0
            }
            _ => true,
        })
    }

    fn place(&self, statement: &Statement) -> Result<Spot, AnalyticError> {
        let of = statement.point;
        let stated = match statement.laid_off() {
            Some((from, direction, distance)) => {
                let (from, along) = (self.spot(of, from)?, at_angle(direction.value));
                let at = [0, 1].map(|i| from.at[i] + along[i] * distance.value);
                let rounding = 4.0 * U * (at[0].abs() + at[1].abs() + distance.value);
                let turned = distance.value * direction.error;
                Spot { at, error: from.error + distance.error + turned + rounding }
            }
            None => self.meet(of, &statement.loci, statement.near)?,
        };
        let settled = match statement.standing {
            Standing::Stated | Standing::Hint | Standing::Driven => return Ok(stated),
            Standing::Onto(locus) => self.onto(of, &locus, stated)?,
            Standing::AtMeet(loci) => self.at_meet(of, &loci, stated)?,
        };
        if length(minus(settled.at, stated.at)) > ROUNDING * self.size + stated.error + settled.error {
            return Err(self.fault(of, "it is stated beside what its links and guides make of it"));
        }
        Ok(settled)
    }

    /// Where two loci meet next to a stated place. Curves that touch leave open where along them the point is: there it is
    /// stated.
    fn at_meet(&self, of: PointId, loci: &[Locus; 2], stated: Spot) -> Result<Spot, AnalyticError> {
        let met = self.meet(of, loci, Some(stated.at));
        // Two lines that are one but for rounding meet somewhere, with a bound that says that it may be anywhere.
        let says_where = match &met {
            Ok(spot) => spot.error <= ROUNDING * self.size + stated.error,
            // Curves that touch may by rounding cross twice about it.
            Err(AnalyticError::Unplaced { .. } | AnalyticError::Ambiguous { .. }) => false,
            Err(_) => true,
        };
        if says_where {
            return met;
        }
        let on_first = self.onto(of, &loci[0], stated)?;
        let second = self.curve(of, &loci[1])?;
        let miss = second.miss(on_first.at).map_or(f64::INFINITY, |(miss, _)| miss.abs());
        let room = on_first.error + second.error_at(on_first.at);
        if miss > ROUNDING * self.size + room { met } else { Ok(on_first) }
    }

    /// The foot of a place on a locus.
    fn onto(&self, of: PointId, locus: &Locus, from: Spot) -> Result<Spot, AnalyticError> {
        let curve = self.curve(of, locus)?;
        let mut at = from.at;
        for _ in 0..3 {
            let Some((miss, normal)) = curve.miss(at) else { break };
            at = [0, 1].map(|i| at[i] - miss * normal[i]);
        }
        Ok(Spot { at, error: from.error + curve.error_at(at) })
    }

    /// Where two loci meet; of two places the one next to `near`.
    fn meet(&self, of: PointId, loci: &[Locus; 2], near: Option<Xy>) -> Result<Spot, AnalyticError> {
        let [first, second] = loci.each_ref();
        let curves = [self.curve(of, first)?, self.curve(of, second)?];
        let grazes = || self.fault(of, "what is stated of it only touches, and does not say where it stands");
        let mut found = Vec::new();
        let mut places = meets(&curves[0], &curves[1]).ok_or_else(grazes)?;
        for end in Locus::blind_ends(loci) {
            // One of the meets is that end, found once more.
            let end = self.spot(of, end)?.at;
            let away = |at: &Xy| length(minus(*at, end));
            if let Some(nearest) =
                (0..places.len()).min_by(|i, j| away(&places[*i]).total_cmp(&away(&places[*j])))
            {
                places.remove(nearest);
            }
        }
        for at in places {
            if self.holds(of, first, at)? && self.holds(of, second, at)? {
                found.push(at);
            }
        }
        let distance = |at: &Xy| near.map(|near| length(minus(*at, near)));
        let at = match *found.as_slice() {
            [] => return Err(self.fault(of, "what is stated of it does not meet")),
            [only] => only,
            [one, other, ..] => match (distance(&one), distance(&other)) {
                (Some(a), Some(b)) if (a - b).abs() > TIE * (a + b) => {
                    if a < b {
                        one
                    } else {
                        other
                    }
                }
                _ => return Err(AnalyticError::Ambiguous { points: vec![self.name(of)] }),
            },
        };
        self.polished(&curves, at).ok_or_else(grazes)
    }

    /// Newton's iteration on both equations, with the bound of what comes out.
    fn polished(&self, curves: &[Curve; 2], mut at: Xy) -> Option<Spot> {
        for _ in 0..4 {
            let [(a, n), (b, m)] = [curves[0].miss(at)?, curves[1].miss(at)?];
            let sine = cross(n, m);
            let by = [(a * m[1] - b * n[1]) / sine, (n[0] * b - m[0] * a) / sine];
            if !by.iter().all(|x| x.is_finite()) {
                return None;
            }
            at = minus(at, by);
        }
        let [(a, n), (b, m)] = [curves[0].miss(at)?, curves[1].miss(at)?];
        let sine = cross(n, m).abs();
        let errors = [curves[0].error_at(at) + a.abs(), curves[1].error_at(at) + b.abs()];
        let first_order = (errors[0] + errors[1]) / sine;
        let curvature = curves[0].curvature() + curves[1].curvature();
        // So much may the angle be another at which they cross.
        let turned = first_order * curvature + curves[0].swing + curves[1].swing;
        let fine = first_order.is_finite() && turned / sine <= CURVED;
        fine.then_some(Spot { at, error: SAFETY * first_order })
    }
}
