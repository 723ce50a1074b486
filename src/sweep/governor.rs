//! A governor over the places of its sleeve: at which speed it is in equilibrium, and what that says of its stability.

use crate::mechanism::force::{Force, Heaviness, Share};
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{Mechanism, PointId};

use super::{Sweep, SweepError};

/// So many places of the range are looked at.
const LOOKS: u32 = 480;
/// The speed that changes by less than this part of itself over a range is one speed.
const ONE_SPEED: f64 = 1e-6;
/// A ball nearer to the axis than this part of the largest distance is on it.
const ON_AXIS: f64 = 1e-9;
/// A branch that ends nearer than this part of the range to a limit of the mechanism ends there.
const AT_LIMIT: f64 = 1e-9;

/// A governor at one place of its input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    /// The input, SI.
    pub at: f64,
    /// Distance of the ball from the axis, m.
    pub radius: f64,
    /// Speed of equilibrium without the drag of the sleeve, rad/s.
    pub speed: f64,
    /// The same while the sleeve is about to move along its guide, and back.
    pub rising_falling: [f64; 2],
}

/// What a part of the range is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// Fc/r grows with r: to every speed belongs one place.
    Stable,
    /// Fc/r is one number.
    Isochronous,
    /// Fc/r falls with r.
    Unstable,
}

impl Stability {
    /// Its name in reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Isochronous => "isochronous",
            Self::Unstable => "unstable",
        }
    }
}

/// A part of the range in which a governor behaves alike.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Part {
    /// How.
    pub stability: Stability,
    /// From the smaller to the larger distance of the ball from the axis, m.
    pub radii: [f64; 2],
    /// The input there, SI.
    pub at: [f64; 2],
}

/// A governor led over the range of its input.
#[derive(Debug, Clone)]
pub struct Governed {
    /// What was swept: the speeds rising and falling, and the place of the ball.
    pub sweep: Sweep,
    /// The point whose distance from the axis counts, the centre of the heaviest mass that is not on the sleeve.
    pub ball: PointId,
    /// Its mass, kg.
    pub mass: f64,
    /// Whether the sleeve rubs, so that it rises and falls at different speeds.
    pub drags: bool,
    /// Places about the scene's own, as far as there is equilibrium and the ball goes on outward or inward, by radius.
    pub places: Vec<Place>,
    /// The parts of the range in which these places lie, in the order of their radii.
    pub parts: Vec<Part>,
    /// The parts in which the scene's own place does not lie, in the order of the input.
    pub elsewhere: Vec<Part>,
}

/// A place, and how it goes on there.
#[derive(Debug, Clone, Copy)]
struct Look {
    place: Place,
    way: Way,
    /// Whether the speed grows with the radius.
    grows: bool,
}

/// What is one over a branch: on which side of the axis the ball is, and whether it goes outward with the input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Way {
    left: bool,
    outward: bool,
}

/// The columns of the sweep that count for a governor.
struct Looking<'a> {
    sweep: &'a Sweep,
    /// Those of the speeds at which it rises and falls, which are one where nothing drags.
    speeds: [usize; 2],
    /// Those of the ball's place.
    ball: [usize; 2],
    through: [f64; 2],
    along: [f64; 2],
}

impl Looking<'_> {
    /// The governor at one place; none where there is no equilibrium.
    fn at(&self, at: f64) -> Option<Look> {
        let values = self.sweep.at(at)?;
        let read = |column: usize| values.get(column).copied().flatten();
        let (rising, falling) = (read(self.speeds[0])?, read(self.speeds[1])?);
        let (x, y) = (read(self.ball[0])?, read(self.ball[1])?);
        let across = self.across([x.value, y.value]);
        let sliding = self.turned([x.slope, y.slope]);
        // ω² is a sum of what acts: without the drag it lies in the middle.
        let square = f64::midpoint(rising.value * rising.value, falling.value * falling.value);
        let steeper = rising.value * rising.slope + falling.value * falling.slope;
        let left = across > 0.0;
        let outward = (sliding > 0.0) == left;
        Some(Look {
            place: Place {
                at,
                radius: across.abs(),
                speed: libm::sqrt(square),
                rising_falling: [rising.value, falling.value],
            },
            way: Way { left, outward },
            grows: (steeper > 0.0) == outward,
        })
    }

    /// How far from the axis the ball is where the mechanism stands, whether there is equilibrium or not.
    fn radius(&self, at: f64) -> Option<f64> {
        let values = self.sweep.at(at)?;
        let [x, y] = self.ball.map(|column| values.get(column).copied().flatten());
        let (x, y) = (x?, y?);
        Some(self.across([x.value, y.value]).abs()).filter(|radius| radius.is_finite())
    }

    fn across(&self, [x, y]: [f64; 2]) -> f64 {
        self.turned([x - self.through[0], y - self.through[1]])
    }

    fn turned(&self, [x, y]: [f64; 2]) -> f64 {
        x * self.along[1] - y * self.along[0]
    }

    /// The last place, from one where something holds towards one where it does not, at which it holds.
    fn last(&self, from: Look, towards: f64, holds: impl Fn(&Look) -> bool) -> Look {
        let (mut here, mut there) = (from, towards);
        loop {
            let middle = f64::midpoint(here.place.at, there);
            if middle == here.place.at || middle == there {
                return here;
            }
            match self.at(middle).filter(|look| holds(look)) {
                Some(look) => here = look,
                None => there = middle,
            }
        }
    }

    /// The end of a branch: where equilibrium ends, or where the mechanism does.
    fn end(&self, from: Look, towards: f64) -> Look {
        let mut end = self.last(from, towards, |look| look.way == from.way);
        let limits = self.sweep.stretches.iter().flat_map(|stretch| [stretch.from, stretch.to]);
        let near = AT_LIMIT * (self.sweep.range[1] - self.sweep.range[0]);
        let limit = limits.into_iter().find(|limit| (limit - end.place.at).abs() <= near);
        if let Some((at, radius)) = limit.and_then(|at| Some((at, self.radius(at)?))) {
            (end.place.at, end.place.radius) = (at, radius);
        }
        end
    }

    /// The branches over these places, each with its ends, in the order of the input.
    fn branches(&self, looks: &[f64]) -> Vec<Vec<Look>> {
        let mut branches: Vec<Vec<Look>> = Vec::new();
        let mut before: Option<f64> = None;
        for (at, look) in looks.iter().map(|at| (*at, self.at(*at))) {
            let goes_on = |branch: &Vec<Look>| {
                branch
                    .last()
                    .zip(look)
                    .is_some_and(|(last, look)| Some(last.place.at) == before && last.way == look.way)
            };
            match (branches.last_mut().filter(|branch| goes_on(branch)), look) {
                (Some(branch), Some(look)) => branch.push(look),
                (_, look) => {
                    let open = branches.last_mut().and_then(|branch| {
                        let last = *branch.last()?;
                        (Some(last.place.at) == before).then_some((branch, last))
                    });
                    if let Some((branch, last)) = open {
                        branch.push(self.end(last, at));
                    }
                    if let Some(look) = look {
                        let start = before.map(|before| self.end(look, before));
                        branches.push(start.into_iter().chain([look]).collect());
                    }
                }
            }
            before = Some(at);
        }
        branches
    }

    /// Where along a branch the speed grows with the radius, where it falls, and where it stays.
    fn parts(&self, branch: &[Look]) -> Vec<Part> {
        let speeds = || branch.iter().map(|look| look.place.speed);
        let (least, most) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
        let ends = branch.first().zip(branch.last()).filter(|_| branch.len() > 1);
        let Some((first, last)) = ends else { return Vec::new() };
        let part = |stability, from: Place, to: Place| {
            let mut ends = [from, to];
            ends.sort_by(|a, b| a.radius.total_cmp(&b.radius));
            Part { stability, radii: ends.map(|place| place.radius), at: ends.map(|place| place.at) }
        };
        if most - least <= ONE_SPEED * most {
            return vec![part(Stability::Isochronous, first.place, last.place)];
        }
        let kind = |grows| if grows { Stability::Stable } else { Stability::Unstable };
        // At an end that is a limit a speed may have no slope.
        let inner = &branch[usize::from(branch.len() > 2)..];
        let inner = &inner[..inner.len() - usize::from(inner.len() > 2)];
        let mut from = first.place;
        let mut parts = Vec::new();
        for pair in inner.windows(2) {
            let [before, after] = [pair[0], pair[1]];
            if before.grows != after.grows {
                let turn = self.last(before, after.place.at, |look| look.grows == before.grows);
                parts.push(part(kind(before.grows), from, turn.place));
                from = turn.place;
            }
        }
        parts.push(part(kind(inner[inner.len() - 1].grows), from, last.place));
        parts
    }
}

/// Leads a governor over the range of its input, or over this one, SI units; none of a mechanism whose speed of
/// equilibrium is not sought, or where its position has none.
///
/// # Errors
/// See [`SweepError`].
pub fn governed(mechanism: &Mechanism, range: Option<[f64; 2]>) -> Result<Option<Governed>, SweepError> {
    let Some(spin) = mechanism.forces.spin.filter(|spin| spin.omega == SpinSpeed::Sought) else {
        return Ok(None);
    };
    let g = mechanism.forces.gravity.g.value;
    let kilograms = |heaviness: Heaviness| match heaviness {
        Heaviness::Mass(mass) => Some(mass.value),
        Heaviness::Weight(weight) => Some(weight.value / g),
        Heaviness::None => None,
    };
    let balls = mechanism.forces.masses.iter().filter(|mass| spin.sleeve != Some(mass.link));
    let balls = balls.filter_map(|mass| Some((mass.centre, kilograms(mass.heaviness)?)));
    let Some((ball, mass)) = balls.reduce(|a, b| if b.1 > a.1 { b } else { a }) else { return Ok(None) };
    let mut asking = mechanism.clone();
    let asked = |quantity: Quantity, symbol: &str| Asked {
        name: quantity.name(mechanism),
        quantity,
        unit: Unit { symbol: symbol.to_owned(), si: 1.0 },
        method: Method::default(),
    };
    let speed = |share| asked(Quantity::Force(Force::Spin, share), "rad/s");
    let drags = spin.drag.is_some();
    let shares = if drags { [Share::Rising, Share::Falling] } else { [Share::Total; 2] };
    asking.asked = shares[usize::from(!drags)..].iter().map(|share| speed(*share)).collect();
    asking.asked.push(asked(Quantity::Position(ball), "m"));
    let sweep = Sweep::new(&asking, range)?;
    // What nothing determines has no column.
    let column = |quantity: Quantity, axis: Option<usize>| {
        sweep.columns.iter().position(|own| own.asked.quantity == quantity && own.axis == axis)
    };
    let speeds = shares.map(|share| column(Quantity::Force(Force::Spin, share), None));
    let place = [0, 1].map(|axis| column(Quantity::Position(ball), Some(axis)));
    let ([Some(rising), Some(falling)], [Some(x), Some(y)]) = (speeds, place) else { return Ok(None) };
    let [through, along] = [spin.through.map(|given| given.value), {
        let angle = spin.angle.value;
        [libm::cos(angle), libm::sin(angle)]
    }];
    let looking = Looking { sweep: &sweep, speeds: [rising, falling], ball: [x, y], through, along };
    let start = sweep.start;
    // A look at its own place again would tell nothing but roundings.
    let apart = (sweep.range[1] - sweep.range[0]) / f64::from(4 * LOOKS);
    let mut looks: Vec<f64> =
        sweep.equal_steps(LOOKS).into_iter().filter(|at| (at - start).abs() > apart).collect();
    if (sweep.range[0]..=sweep.range[1]).contains(&start) {
        looks.insert(looks.partition_point(|at| *at <= start), start);
    }
    let mut branches = looking.branches(&looks);
    let (mut places, mut parts, mut elsewhere) = (Vec::new(), Vec::new(), Vec::new());
    let largest = branches.iter().flatten().map(|look| look.place.radius).fold(0.0, f64::max);
    for look in branches.iter_mut().flatten() {
        // A ball that comes to the axis is on it.
        if look.place.radius <= ON_AXIS * largest {
            look.place.radius = 0.0;
        }
    }
    for branch in &branches {
        let own = branch.iter().any(|look| look.place.at == start);
        if own && places.is_empty() {
            let at_looks = branch.iter().map(|look| look.place).filter(|place| looks.contains(&place.at));
            places = at_looks.collect();
            parts = looking.parts(branch);
        } else {
            elsewhere.extend(looking.parts(branch));
        }
    }
    places.sort_by(|a, b| a.radius.total_cmp(&b.radius));
    parts.sort_by(|a, b| a.radii[0].total_cmp(&b.radii[0]));
    Ok(Some(Governed { sweep, ball, mass, drags, places, parts, elsewhere }))
}

impl Governed {
    /// The controlling force M ω² r at a place, N.
    #[must_use]
    pub fn force(&self, place: &Place, speed: f64) -> f64 {
        self.mass * speed * speed * place.radius
    }
}
