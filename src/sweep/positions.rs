//! Other positions of a mechanism, for its skeleton: with the input elsewhere, and in its other assembly.
//!
//! Each is drawn by the constructions of the skeleton, as a sweep's are. The input is led to its new place by
//! short steps, so that the assembly is kept.

use std::f64::consts::TAU;

use super::{SweepError, prepare};
use crate::given::Given;
use crate::graphical::construction::{OtherKind, OtherPosition};
use crate::graphical::{self, DrawError};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, Mechanism, Place, PointId};
use crate::plan::{CentreSource, Extent, Plan};

/// Why another position cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PositionError {
    /// The mechanism does not move on as it is given.
    #[error(transparent)]
    Sweep(#[from] SweepError),
    /// The chain opens on the way, in both directions.
    #[error("the chain opens before the input comes there")]
    Range(f64),
    /// Too far to be followed.
    #[error("this is more than {MOST_TURNS} turns, or lengths of the mechanism, away")]
    Far(f64),
    /// Every group closes in one way only.
    #[error("the mechanism has no other assembly at this input")]
    NoOtherAssembly,
}

/// Steps in a whole turn, or in the length of the mechanism, before any is halved.
const STEPS: f64 = 240.0;
/// A step that moves a point by more than this part of the mechanism's size is halved.
const LONGEST_MOVE: f64 = 0.08;
/// Halvings of a step.
const HALVINGS: u32 = 10;
/// The input is followed over this many turns at most.
const MOST_TURNS: f64 = 20.0;
/// Assemblies that differ by less than this part of the mechanism's size are one.
const ONE_ASSEMBLY: f64 = 1e-6;

/// Places by point, metres in the world.
type Places = Vec<Option<[f64; 2]>>;

/// The mechanism with its first input at each of `inputs`, and in its other assembly where that is wanted: the one
/// in which the first group that closes in two ways closes in its other one.
///
/// # Errors
/// See [`PositionError`].
pub fn other_positions(
    mechanism: &Mechanism,
    inputs: &[f64],
    assembly: bool,
) -> Result<Vec<OtherPosition>, PositionError> {
    if inputs.is_empty() && !assembly {
        return Ok(Vec::new());
    }
    let standing = graphical::standing(mechanism).map_err(SweepError::from)?;
    let mover = Mover::new(&standing)?;
    let mut all = Vec::new();
    for &to in inputs {
        all.push(mover.shown(OtherKind::Input(to), mover.led_to(to)?)?);
    }
    if assembly {
        let other = mover.other_assembly().ok_or(PositionError::NoOtherAssembly)?;
        all.push(mover.shown(OtherKind::Assembly, other)?);
    }
    Ok(all)
}

/// The mechanism in another position: its first input there, and every point of it near where that has it.
///
/// # Errors
/// Where the mechanism does not move on as it is given.
pub fn moved_to(mechanism: &Mechanism, other: &OtherPosition) -> Result<Mechanism, SweepError> {
    let (mut moved, _, _) = prepare::ready(mechanism, &prepare::Moved::all(mechanism))?;
    moved.asked.clear();
    if let OtherKind::Input(to) = other.kind {
        put(&mut moved, to);
    }
    let origin = graphical::origin(mechanism);
    let places = other.places.iter().map(|at| at.map(|at| [origin[0] + at[0], origin[1] + at[1]]));
    hint(&mut moved, &places.collect());
    Ok(moved)
}

/// A mechanism that can be moved.
struct Mover {
    mechanism: Mechanism,
    structure: Structure,
    plan: Plan,
    /// Where the input stands in the scene.
    start: f64,
    present: Places,
    /// World coordinates of the skeleton's origin.
    origin: [f64; 2],
    size: f64,
}

impl Mover {
    fn new(mechanism: &Mechanism) -> Result<Self, SweepError> {
        let whole = |mechanism: &Mechanism, structure: &Structure| {
            Plan::with(mechanism, structure, Extent::WholeSkeleton, CentreSource::Diagram)
        };
        let (mut ready, _, start) = prepare::ready(mechanism, &prepare::Moved::all(mechanism))?;
        ready.asked.clear();
        let mut asked_nothing = mechanism.clone();
        asked_nothing.asked.clear();
        let structure = Structure::of(&asked_nothing)?;
        let present = graphical::places(&asked_nothing, &structure, &whole(&asked_nothing, &structure))?;
        let structure = Structure::of(&ready)?;
        prepare::refuse_rolled_points(&ready, &structure)?;
        let plan = whole(&ready, &structure);
        let known: Vec<[f64; 2]> = present.iter().copied().flatten().collect();
        let extent = |axis: usize| {
            let least = known.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
            known.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max) - least
        };
        let size = libm::hypot(extent(0), extent(1));
        let origin = graphical::origin(mechanism);
        let mut mover = Self { mechanism: ready, structure, plan, start, present, origin, size };
        let near = mover.present.clone();
        hint(&mut mover.mechanism, &near);
        // What does not stand by its own dimensions is told before it is moved.
        mover.drawn(&mover.mechanism)?;
        Ok(mover)
    }

    fn shown(&self, kind: OtherKind, places: Places) -> Result<OtherPosition, SweepError> {
        let mut moved = self.mechanism.clone();
        if let OtherKind::Input(to) = kind {
            put(&mut moved, to);
        }
        hint(&mut moved, &places);
        let axes = graphical::axes(&moved, &self.structure, &self.plan)?;
        let from_origin = |at: [f64; 2]| [0, 1].map(|axis| at[axis] - self.origin[axis]);
        Ok(OtherPosition { kind, places: places.into_iter().map(|at| at.map(from_origin)).collect(), axes })
    }

    fn drawn(&self, mechanism: &Mechanism) -> Result<Places, DrawError> {
        graphical::places(mechanism, &self.structure, &self.plan)
    }

    /// The places with the input there and the points near these places.
    fn at(&self, input: f64, near: &Places) -> Option<Places> {
        let mut moved = self.mechanism.clone();
        put(&mut moved, input);
        hint(&mut moved, near);
        self.drawn(&moved).ok()
    }

    /// The places when the input has come to `to` without leaving the assembly. An angle that cannot be come to one
    /// way round is tried the other way round.
    fn led_to(&self, to: f64) -> Result<Places, PositionError> {
        let turns = !matches!(self.mechanism.inputs.first(), Some(Input::Slide { .. }));
        let whole = if turns { TAU } else { self.size };
        if (to - self.start).abs() > MOST_TURNS * whole {
            return Err(PositionError::Far(to));
        }
        let round = if to > self.start { to - TAU } else { to + TAU };
        let direct = self.walk(to, whole / STEPS);
        let found = direct.or_else(|| if turns { self.walk(round, whole / STEPS) } else { None });
        found.ok_or(PositionError::Range(to))
    }

    fn walk(&self, to: f64, longest: f64) -> Option<Places> {
        let (mut at, mut places) = (self.start, self.present.clone());
        let mut before: Option<(f64, Places)> = None;
        while at != to {
            let left = to - at;
            let mut goal = if left.abs() <= longest { to } else { at + longest.copysign(left) };
            let mut next = None;
            for _ in 0..HALVINGS {
                let near = match &before {
                    Some((then, earlier)) => expected(&places, earlier, (goal - at) / (at - then)),
                    None => places.clone(),
                };
                next = self.at(goal, &near).filter(|found| apart(found, &places) < LONGEST_MOVE * self.size);
                if next.is_some() {
                    break;
                }
                goal = f64::midpoint(at, goal);
            }
            let found = next?;
            before = Some((at, std::mem::replace(&mut places, found)));
            at = goal;
        }
        Some(places)
    }

    /// The places in which the first group that closes in two ways closes in its other one, and those after it as near
    /// to the present position as they can.
    fn other_assembly(&self) -> Option<Places> {
        self.structure.groups.iter().find_map(|group| {
            let mut open = self.mechanism.clone();
            let earlier = self.structure.groups.iter().take_while(|other| *other != group);
            let settled: Vec<PointId> = earlier
                .flat_map(|g| &g.links)
                .flat_map(|&l| &self.mechanism.link(l).points)
                .copied()
                .collect();
            for &point in group.links.iter().flat_map(|&l| &self.mechanism.link(l).points) {
                let place = &mut open.points[point.0].place;
                if !settled.contains(&point) && place.exact().is_none() {
                    *place = Place::Unknown;
                }
            }
            let Err(DrawError::Ambiguous { pin, first, second }) = self.drawn(&open) else { return None };
            let now = self.present.get(pin.0).copied().flatten()?;
            let away = |at: [f64; 2]| libm::hypot(at[0] - now[0], at[1] - now[1]);
            let other = if away(first) > away(second) { first } else { second };
            open.points[pin.0].place = Place::Near(other);
            let places = self.drawn(&open).ok()?;
            (apart(&places, &self.present) > ONE_ASSEMBLY * self.size).then_some(places)
        })
    }
}

/// Puts the first input there.
fn put(mechanism: &mut Mechanism, to: f64) {
    match mechanism.inputs.first_mut() {
        Some(Input::Angle { angle, .. } | Input::Speed { angle, .. }) => *angle = Some(Given::exact(to)),
        Some(Input::Slide { at, .. }) => *at = Some(Given::exact(to)),
        None => {}
    }
}

/// Makes these places the hints for all moving points.
fn hint(mechanism: &mut Mechanism, near: &Places) {
    for (point, near) in mechanism.points.iter_mut().zip(near) {
        if let (Some(near), Place::Near(_) | Place::Unknown) = (near, point.place) {
            point.place = Place::Near(*near);
        }
    }
}

/// The longest way that a point has moved.
fn apart(a: &Places, b: &Places) -> f64 {
    let ways = a.iter().zip(b).filter_map(|(p, q)| Some(((*p)?, (*q)?)));
    ways.map(|(p, q)| libm::hypot(p[0] - q[0], p[1] - q[1])).fold(0.0, f64::max)
}

/// Where the points will be if they move on as they moved last.
fn expected(now: &Places, before: &Places, part: f64) -> Places {
    let part = part.clamp(-2.0, 2.0);
    let moved = |(now, before): (&Option<[f64; 2]>, &Option<[f64; 2]>)| {
        let (now, before) = ((*now)?, before.or(*now)?);
        Some([0, 1].map(|axis| now[axis] + (now[axis] - before[axis]) * part))
    };
    now.iter().zip(before).map(moved).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn scene(kind: &str) -> crate::scene::Scene {
        let kind = crate::catalogue::KINDS.iter().find(|k| k.name == kind).unwrap();
        crate::scene::read(kind.scene, kind.name).unwrap()
    }

    fn place(scene: &crate::scene::Scene, other: &OtherPosition, name: &str) -> [f64; 2] {
        let point = scene.mechanism.points.iter().position(|p| p.name == name).unwrap();
        other.places[point].unwrap()
    }

    /// The law of cosines for the slider of a centric slider-crank, in both assemblies.
    #[test]
    fn a_slider_stands_where_its_triangle_closes() {
        let scene = scene("slider-crank");
        let length =
            |name: u32| match scene.mechanism.links[scene.mechanism.link_numbered(name).unwrap().0].form {
                crate::mechanism::Form::Length(l) => l.value,
                _ => panic!("a rod has a length"),
            };
        let (crank, rod) = (length(2), length(3));
        let angles = [-1.0, 0.5, 3.0, 7.0];
        let others = other_positions(&scene.mechanism, &angles, true).unwrap();
        let Some(Input::Angle { angle: Some(now), .. }) = scene.mechanism.inputs.first() else { panic!() };
        let all = angles.iter().map(|a| (*a, 1.0)).chain([(now.value, -1.0)]);
        for ((angle, side), other) in all.zip(&others) {
            let (sin, cos) = libm::sincos(angle);
            let closed = crank * cos + side * (rod * rod - crank * crank * sin * sin).sqrt();
            let [x, y] = place(&scene, other, "B");
            assert!((x - closed).abs() < 1e-12 && y.abs() < 1e-12, "{angle}: {x} {y} {closed}");
        }
    }

    /// What moves keeps its lengths, and the other assembly is another.
    #[test]
    fn links_keep_their_lengths() {
        for kind in ["four-bar", "whitworth", "stephenson", "toggle-press"] {
            let scene = scene(kind);
            let mover = Mover::new(&scene.mechanism).unwrap();
            let others = other_positions(&scene.mechanism, &[0.9], true).unwrap();
            assert_eq!(others.last().unwrap().kind, OtherKind::Assembly);
            for other in &others {
                let moved = |p: PointId| other.places[p.0].unwrap();
                let now = |p: PointId| mover.present[p.0].unwrap();
                let between = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]);
                for link in &scene.mechanism.links {
                    for pair in link.points.windows(2) {
                        let (then, here) =
                            (between(moved(pair[0]), moved(pair[1])), between(now(pair[0]), now(pair[1])));
                        assert!((then - here).abs() < 1e-9 * mover.size, "{kind}: {then} {here}");
                    }
                }
            }
        }
    }

    #[test]
    fn what_cannot_be_come_to_is_refused() {
        let rocker = scene("double-rocker");
        assert!(matches!(other_positions(&rocker.mechanism, &[3.2], false), Err(PositionError::Range(_))));
        let crank = scene("four-bar");
        assert!(matches!(other_positions(&crank.mechanism, &[1e6], false), Err(PositionError::Far(_))));
        assert!(matches!(
            other_positions(&scene("geneva").mechanism, &[], true),
            Err(PositionError::NoOtherAssembly)
        ));
    }
}
