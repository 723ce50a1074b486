//! What a sheet shows beside its skeleton, polygons and circle diagram: constructions on the skeleton, velocities
//! carried over by instant centres, other positions of the mechanism.
//!
//! These numbers are read on boards whose tape is gone, or off the paper, so that no bound goes with them. They are
//! confirmed to some digits more than a sheet prints: where they are not, the sheet would print a wrong one.

use crate::analytic::{self, State};
use crate::graphical::auxiliary::{AuxiliaryAct, AuxiliaryDrawing, PointName};
use crate::graphical::construction::{
    Calculation, Construction, OtherPosition, Spot, Transfer, TransferAct, TransferInk,
};
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Answer, Quantity};
use crate::mechanism::statement::Locus;
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::scene::{Scene, unit_of};
use crate::sweep;

use super::confirm::{Disagreement, Unconfirmed};

/// Part of a number by which what has no bound may be off; a sheet prints four digits.
const DIGITS: f64 = 1e-7;
/// The same of the largest number of its kind, for one that is small beside it.
const BESIDE: f64 = 1e-10;
/// Part of the mechanism's size by which a point of another position may be off.
const PLACE: f64 = 1e-9;

/// A number beside the polygons.
#[derive(Debug, Clone, Copy)]
enum Told {
    /// A number with its sign.
    Number(Quantity, f64),
    /// The magnitude of a vector.
    Size(Quantity, f64),
    /// A place in the world, m.
    Place(Quantity, [f64; 2]),
    /// The diameter of a link's inflection circle, m.
    Inflection(LinkId, f64),
}

/// The quantities on which what is shown beside the polygons hangs.
pub(super) fn quantities(scene: &Scene, construction: &Construction) -> Vec<Quantity> {
    let mut all = Vec::new();
    for told in told(scene, construction) {
        match told {
            Told::Number(quantity, _) | Told::Size(quantity, _) | Told::Place(quantity, _) => {
                all.push(quantity)
            }
            Told::Inflection(link, _) => {
                all.extend([Quantity::Omega(link), Quantity::Alpha(link)]);
                for &point in &scene.mechanism.link(link).points {
                    all.extend([
                        Quantity::Position(point),
                        Quantity::Velocity(point),
                        Quantity::Acceleration(point),
                    ]);
                }
            }
        }
    }
    all
}

/// What is not confirmed of it.
pub(super) fn wrong(scene: &Scene, construction: &Construction, state: &State) -> Vec<Disagreement> {
    let all = told(scene, construction);
    let largest = |quantity: &Quantity| {
        let alike = all.iter().filter_map(|told| match told {
            Told::Number(other, value) | Told::Size(other, value) if same_kind(other, quantity) => {
                Some(value.abs())
            }
            _ => None,
        });
        alike.fold(0.0, f64::max)
    };
    let mut wrong = Vec::new();
    for told in &all {
        let (quantity, drawn, expected, floor) = match *told {
            Told::Number(quantity, value) => {
                (quantity, Answer::Scalar { value, bound: 0.0 }, state.answer(&quantity), largest(&quantity))
            }
            Told::Size(quantity, value) => {
                let expected = match state.answer(&quantity) {
                    Answer::Vector { value: [x, y], bound } => {
                        Answer::Scalar { value: libm::hypot(x, y), bound }
                    }
                    other => other,
                };
                (quantity, Answer::Scalar { value: value.abs(), bound: 0.0 }, expected, largest(&quantity))
            }
            Told::Place(quantity, value) => {
                let far = libm::hypot(value[0], value[1]).max(size_of(scene));
                (quantity, Answer::Vector { value, bound: 0.0 }, state.answer(&quantity), far)
            }
            Told::Inflection(link, value) => {
                let quantity = Quantity::Centre(LinkId::FRAME, link);
                let expected = diameter(scene, state, link);
                (quantity, Answer::Scalar { value, bound: 0.0 }, expected, 0.0)
            }
        };
        let apart = super::apart(&drawn, &expected);
        let size = match drawn {
            Answer::Scalar { value, .. } => value.abs(),
            Answer::Vector { value: [x, y], .. } => libm::hypot(x, y),
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => 0.0,
        };
        let apart = apart.map(|(distance, bounds)| (distance, bounds + DIGITS * size + BESIDE * floor));
        if apart.is_some_and(|(distance, bounds)| distance <= bounds) {
            continue;
        }
        let name = match told {
            Told::Inflection(link, _) => {
                format!(
                    "the diameter of the inflection circle of link {}",
                    scene.mechanism.link(*link).number
                )
            }
            _ => quantity.name(&scene.mechanism),
        };
        wrong.push(Disagreement {
            name,
            unit: unit_of(&quantity, scene),
            graphical: drawn,
            analytic: expected,
            apart,
        });
    }
    wrong
}

/// Whether two quantities have one unit and one order.
fn same_kind(a: &Quantity, b: &Quantity) -> bool {
    let turns =
        |q: &Quantity| matches!(q, Quantity::Omega(_) | Quantity::Alpha(_) | Quantity::RelativeOmega(..));
    a.order() == b.order() && turns(a) == turns(b)
}

fn size_of(scene: &Scene) -> f64 {
    let known = scene.mechanism.points.iter().filter_map(|p| p.place.hint());
    let all: Vec<[f64; 2]> = known.collect();
    let extent = |axis: usize| {
        let values = || all.iter().map(|at| at[axis]);
        values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min)
    };
    // Where places are stated, their distances tell it.
    let stated = scene.mechanism.statements.iter().flat_map(|statement| statement.loci);
    let radii = stated.filter_map(|locus| match locus {
        Locus::Circle { radius, .. } => Some(radius.value),
        _ => None,
    });
    let far = radii.fold(0.0, f64::max);
    if all.is_empty() { far } else { libm::hypot(extent(0), extent(1)).max(far) }
}

/// The diameter of the inflection circle by the independent solver: the acceleration of the link's velocity pole over
/// ω².
fn diameter(scene: &Scene, state: &State, link: LinkId) -> Answer {
    let vector = |quantity: Quantity| match state.answer(&quantity) {
        Answer::Vector { value, .. } => Ok(value),
        other => Err(other),
    };
    let scalar = |quantity: Quantity| match state.answer(&quantity) {
        Answer::Scalar { value, .. } => Ok(value),
        other => Err(other),
    };
    let found = |point: PointId| -> Result<Answer, Answer> {
        let (w, e) = (scalar(Quantity::Omega(link))?, scalar(Quantity::Alpha(link))?);
        let (v, a) = (vector(Quantity::Velocity(point))?, vector(Quantity::Acceleration(point))?);
        // From the point to the pole, which has no velocity.
        let [x, y] = [-v[1] / w, v[0] / w];
        let pole = [a[0] - e * y - w * w * x, a[1] + e * x - w * w * y];
        Ok(Answer::Scalar { value: libm::hypot(pole[0], pole[1]) / (w * w), bound: 0.0 })
    };
    let mut refused = None;
    for &point in &scene.mechanism.link(link).points {
        match found(point) {
            Ok(answer) => return answer,
            Err(other) => refused = Some(other),
        }
    }
    refused.unwrap_or_else(|| state.answer(&Quantity::Omega(link)))
}

fn told(scene: &Scene, construction: &Construction) -> Vec<Told> {
    let origin = crate::graphical::origin(&scene.mechanism);
    let mut all = Vec::new();
    for drawing in construction.auxiliary.iter().filter(|drawing| drawing.refused.is_none()) {
        of_drawing(drawing, construction, origin, &mut all);
    }
    for transfer in construction.circle.iter().flat_map(|circle| &circle.transfers) {
        of_transfer(&scene.mechanism, transfer, &mut all);
    }
    all
}

fn of_drawing(
    drawing: &AuxiliaryDrawing,
    construction: &Construction,
    origin: [f64; 2],
    all: &mut Vec<Told>,
) {
    for act in &drawing.acts {
        match *act {
            AuxiliaryAct::ReadImage { quantity, mm, si_per_mm, .. } => {
                all.push(Told::Size(quantity, mm * si_per_mm));
            }
            AuxiliaryAct::Calculate(calculation) => match calculation {
                Calculation::Omega { link, value, .. } => {
                    all.push(Told::Number(Quantity::Omega(link), value))
                }
                Calculation::Alpha { link, value, .. } => {
                    all.push(Told::Number(Quantity::Alpha(link), value))
                }
                Calculation::Normal { quantity, value, .. } | Calculation::Speed { quantity, value, .. } => {
                    all.push(Told::Size(quantity, value));
                }
                _ => {}
            },
            AuxiliaryAct::InflectionCircle { link, diameter, .. } => {
                all.push(Told::Inflection(link, diameter));
            }
            AuxiliaryAct::AccelerationCentre { link, omega, alpha, .. } => {
                all.push(Told::Number(Quantity::Omega(link), omega));
                all.push(Told::Number(Quantity::Alpha(link), alpha));
            }
            AuxiliaryAct::LineOfInertia { link, size, arm, .. } => {
                let force = Force::Vector(Action::Inertia(link));
                all.push(Told::Size(Quantity::Force(force, Share::Total), size));
                all.push(Told::Number(Quantity::Force(Force::Offset(link), Share::Total), arm));
            }
            AuxiliaryAct::EffortOfLever { of, effort, .. } => {
                all.push(Told::Number(Quantity::Force(of, Share::Total), effort));
            }
            _ => {}
        }
    }
    for point in &drawing.points {
        if let PointName::Centre([a, b]) = point.name {
            let per_mm = construction.space.metres_per_mm;
            let at = [0, 1].map(|axis| origin[axis] + point.at[axis] * per_mm);
            all.push(Told::Place(Quantity::Centre(a, b), at));
        }
    }
}

fn of_transfer(mechanism: &Mechanism, transfer: &Transfer, all: &mut Vec<Told>) {
    let has = |link: LinkId, point: PointId| mechanism.link(link).points.contains(&point);
    let mut turns = |link: LinkId, omega: f64| all.push(Told::Number(Quantity::Omega(link), omega));
    let mut speeds: Vec<(PointId, f64)> = Vec::new();
    // Of the point of a link under a pin of another.
    let mut under: Vec<(PointId, LinkId, f64)> = Vec::new();
    let mut relative: Vec<(Quantity, f64)> = Vec::new();
    for act in &transfer.acts {
        match *act {
            TransferAct::Ratio { input, link, omegas, .. } => {
                turns(input, omegas[0]);
                turns(link, omegas[1]);
            }
            TransferAct::CommonSpeed { of, omega, .. } => turns(of, omega),
            TransferAct::AboutPole { link, point, omega, speed, .. } => {
                turns(link, omega);
                if has(link, point) {
                    speeds.push((point, speed));
                } else {
                    under.push((point, link, speed));
                }
            }
            TransferAct::Difference { quantity, speed, .. } => relative.push((quantity, speed)),
            TransferAct::Gauge { point, speed, .. } | TransferAct::Parallel { to: point, speed, .. } => {
                speeds.push((point, speed));
            }
            TransferAct::Omega { link, omega, .. } | TransferAct::OmegaByParallel { link, omega, .. } => {
                turns(link, omega);
            }
            TransferAct::Translation { .. } => {}
        }
    }
    for ink in &transfer.ink {
        let speed =
            |at: [f64; 2], tip: [f64; 2]| libm::hypot(tip[0] - at[0], tip[1] - at[1]) * transfer.si_per_mm;
        match *ink {
            TransferInk::Velocity { at, tip, of: Spot::Point(point) }
            | TransferInk::Turned { at, tip, of: point } => speeds.push((point, speed(at, tip))),
            TransferInk::Velocity { at, tip, of: Spot::Under(point, link) } => {
                under.push((point, link, speed(at, tip)));
            }
            TransferInk::Difference { from, to, of, .. } => relative.push((of, speed(from, to))),
            _ => {}
        }
    }
    all.extend(relative.into_iter().map(|(quantity, speed)| Told::Size(quantity, speed)));
    let carried = |(point, link, speed)| Told::Size(Quantity::CoincidentVelocity(point, link), speed);
    all.extend(under.into_iter().map(carried));
    all.extend(speeds.into_iter().map(|(point, speed)| Told::Size(Quantity::Velocity(point), speed)));
}

/// Whether the independent solver finds the mechanism where its other positions are drawn.
///
/// # Errors
/// [`Unconfirmed::Number`] with the first point that it sees elsewhere, [`Unconfirmed::Refused`] where it finds none.
pub(super) fn confirm_positions(scene: &Scene, construction: &Construction) -> Result<(), Unconfirmed> {
    for other in &construction.others {
        let Ok(moved) = sweep::moved_to(&scene.mechanism, other) else { continue };
        confirm_position(scene, &moved, other)?;
    }
    Ok(())
}

fn confirm_position(scene: &Scene, moved: &Mechanism, other: &OtherPosition) -> Result<(), Unconfirmed> {
    let origin = crate::graphical::origin(&scene.mechanism);
    let drawn: Vec<(PointId, [f64; 2])> = other
        .places
        .iter()
        .enumerate()
        .filter_map(|(index, at)| at.map(|at| (PointId(index), [origin[0] + at[0], origin[1] + at[1]])))
        .collect();
    let wanted: Vec<Quantity> = drawn.iter().map(|(point, _)| Quantity::Position(*point)).collect();
    let state = analytic::solve_for(moved, &wanted)?;
    let size =
        drawn.iter().flat_map(|(_, a)| drawn.iter().map(move |(_, b)| libm::hypot(a[0] - b[0], a[1] - b[1])));
    let size = size.fold(0.0, f64::max);
    for (point, value) in drawn {
        let quantity = Quantity::Position(point);
        let (graphical, analytic) = (Answer::Vector { value, bound: 0.0 }, state.answer(&quantity));
        // A dead position is where it is only to the root of rounding.
        let apart = super::apart(&graphical, &analytic)
            .map(|(distance, bounds)| (distance, 2.0 * bounds + PLACE * size));
        if apart.is_some_and(|(distance, bounds)| distance <= bounds) {
            continue;
        }
        let name = format!("{} in another position", quantity.name(&scene.mechanism));
        let unit = unit_of(&quantity, scene);
        let first = Box::new(Disagreement { name, unit, graphical, analytic, apart });
        return Err(Unconfirmed::Number { first, more: 0 });
    }
    Ok(())
}
