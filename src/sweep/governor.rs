//! A governor over the places of its sleeve: at which speed it is in equilibrium, and what that says of its stability.

use crate::mechanism::force::{Force, Heaviness, Share};
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{Mechanism, PointId};

use super::{Position, Sweep, SweepError};

/// So many places of the range are looked at.
const LOOKS: u32 = 480;
/// The speed that changes by less than this part of itself over a range is one speed.
const ONE_SPEED: f64 = 1e-6;

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
    /// Places along the range, where there is equilibrium.
    pub places: Vec<Place>,
    /// The parts of the range, in the order of their radii.
    pub parts: Vec<Part>,
}

/// Leads a governor over the range of its input; none of a mechanism whose speed of equilibrium is not sought.
///
/// # Errors
/// See [`SweepError`].
pub fn governed(mechanism: &Mechanism) -> Result<Option<Governed>, SweepError> {
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
    let speeds =
        if drags { vec![speed(Share::Rising), speed(Share::Falling)] } else { vec![speed(Share::Total)] };
    let columns = speeds.len();
    asking.asked = speeds;
    asking.asked.push(asked(Quantity::Position(ball), "m"));
    let sweep = Sweep::new(&asking, None)?;
    let [through, along] = [spin.through.map(|given| given.value), {
        let angle = spin.angle.value;
        [libm::cos(angle), libm::sin(angle)]
    }];
    let place = |position: Position| -> Option<(Place, bool)> {
        let own: Option<Vec<f64>> = position.values.iter().take(columns + 2).copied().collect();
        let own = own?;
        let (rising, falling) = if drags { (own[0], own[1]) } else { (own[0], own[0]) };
        let [x, y] = [own[columns] - through[0], own[columns + 1] - through[1]];
        let across = x * along[1] - y * along[0];
        // ω² is a sum of what acts: without the drag it lies in the middle.
        let speed = libm::sqrt(f64::midpoint(rising * rising, falling * falling));
        let place = Place { at: position.at, radius: across.abs(), speed, rising_falling: [rising, falling] };
        Some((place, across > 0.0))
    };
    // A look at its own place again would tell nothing but roundings.
    let apart = (sweep.range[1] - sweep.range[0]) / f64::from(4 * LOOKS);
    let looks: Vec<f64> =
        sweep.equal_steps(LOOKS).into_iter().filter(|at| (at - sweep.start).abs() > apart).collect();
    let start = looks.partition_point(|at| *at <= sweep.start);
    let own = sweep.positions(&[sweep.start]).into_iter().next().and_then(place);
    let mut places: Vec<Place> = own.iter().map(|(place, _)| *place).collect();
    if let Some((own, left)) = own {
        // From its own place on both ways, as far as there is equilibrium and the ball goes on outward or inward.
        let ways: [Vec<f64>; 2] = [looks[start..].to_vec(), looks[..start].iter().rev().copied().collect()];
        let mut outward = None;
        for (way, looks) in ways.into_iter().enumerate() {
            let mut before = own;
            for position in sweep.positions(&looks) {
                let Some((next, side)) = place(position) else { break };
                let grows = (next.radius > before.radius) == (way == 0);
                if side != left || next.radius == before.radius || *outward.get_or_insert(grows) != grows {
                    break;
                }
                places.push(next);
                before = next;
            }
        }
    }
    places.sort_by(|a, b| a.radius.total_cmp(&b.radius));
    let parts = parts(&places);
    Ok(Some(Governed { sweep, ball, mass, drags, places, parts }))
}

impl Governed {
    /// The controlling force M ω² r at a place, N.
    #[must_use]
    pub fn force(&self, place: &Place, speed: f64) -> f64 {
        self.mass * speed * speed * place.radius
    }
}

/// Where the speed grows with the radius, where it falls, and where it stays.
fn parts(places: &[Place]) -> Vec<Part> {
    let speeds = || places.iter().map(|place| place.speed);
    let (least, most) = (speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max));
    let whole = places.first().zip(places.last()).map(|(first, last)| [first.radius, last.radius]);
    let Some(whole) = whole.filter(|_| places.len() > 1) else { return Vec::new() };
    if most - least <= ONE_SPEED * most {
        return vec![Part { stability: Stability::Isochronous, radii: whole }];
    }
    let mut parts: Vec<Part> = Vec::new();
    for ends in places.windows(2) {
        let [from, to] = [ends[0], ends[1]];
        let stability = if to.speed > from.speed { Stability::Stable } else { Stability::Unstable };
        match parts.last_mut() {
            Some(part) if part.stability == stability => part.radii[1] = to.radius,
            _ => parts.push(Part { stability, radii: [from.radius, to.radius] }),
        }
    }
    parts
}
