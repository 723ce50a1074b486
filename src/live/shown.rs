//! What the page shows besides what was asked: everything that stands on the paper.

use std::f64::consts::PI;

use crate::graphical::construction::{Found, Spot, TransferInk};
use crate::mechanism::quantity::{Asked, Method, Order, Quantity, Unit};
use crate::mechanism::{Input, LinkId, PointId};
use crate::plan::Auxiliary;
use crate::scene::Scene;
use crate::solve::Solved;
use crate::sweep::Over;

/// Everything that stands on the paper of a solution, as if it had been asked, in the scene's units.
pub(super) fn besides(scene: &Scene, solved: &Solved, over: Over) -> Vec<Asked> {
    let mechanism = &scene.mechanism;
    let shown = solved.solution.shown.iter().map(|shown| shown.quantity);
    let construction = &solved.solution.construction;
    let vectors = construction.diagrams.iter().flat_map(|diagram| &diagram.vectors);
    let vectors = vectors.map(|vector| vector.quantity);
    // Which way a link with one joint looks is told by nothing else.
    let placed = |point: &PointId| construction.space.places[point.0].is_some();
    let single = |link: &LinkId| mechanism.link(*link).points.iter().filter(|p| placed(p)).count() == 1;
    // What cannot be drawn does not move either.
    let left_out = |link: &LinkId| {
        solved.left_out.as_ref().is_some_and(|out| out.links.contains(&mechanism.link(*link).number))
    };
    let angles = mechanism.moving().filter(|link| single(link) && !left_out(link)).map(Quantity::Angle);
    let mut all: Vec<Asked> = Vec::new();
    let circle = construction.circle.iter().flat_map(|circle| &circle.centres);
    let centres = circle.filter(|centre| !matches!(centre.found, Found::Pin(_)));
    let centres = centres.map(|centre| Quantity::Centre(centre.links[0], centre.links[1]));
    // What a construction on the skeleton besides the polygons hangs on.
    let drawn = construction.auxiliary.iter().find(|drawing| drawing.refused.is_none());
    let klein = construction.auxiliary.iter().any(|d| matches!(d.kind, Auxiliary::Klein { .. }));
    let points = || (0..mechanism.points.len()).map(PointId).filter(|p| placed(p) && !mechanism.is_fixed(*p));
    // What is read off a construction on the skeleton is asked for and stands on no polygon.
    let asked = mechanism.asked.iter().map(|asked| asked.quantity);
    let second = shown.clone().chain(asked).any(|quantity| quantity.order() == Order::Acceleration);
    // The arrows of driven links.
    let driven = mechanism.inputs.iter().filter_map(|input| match *input {
        Input::Angle { link, alpha, .. } | Input::Speed { link, alpha, .. } => {
            Some((link, second || alpha.value != 0.0))
        }
        Input::Slide { .. } => None,
    });
    let over_time = driven.clone().filter(|_| over == Over::Time);
    let mut more: Vec<Quantity> = over_time.map(|(link, _)| Quantity::Angle(link)).collect();
    more.extend(driven.clone().map(|(link, _)| Quantity::Omega(link)));
    more.extend(driven.filter(|(_, has_alpha)| *has_alpha).map(|(link, _)| Quantity::Alpha(link)));
    if drawn.is_some() || construction.circle.as_ref().is_some_and(|circle| !circle.transfers.is_empty()) {
        more.extend(points().map(Quantity::Velocity));
    }
    for ink in construction.circle.iter().flat_map(|circle| &circle.transfers).flat_map(|own| &own.ink) {
        match *ink {
            TransferInk::Velocity { of: Spot::Under(point, link), .. } => {
                more.push(Quantity::CoincidentVelocity(point, link));
            }
            TransferInk::Difference { of, .. } => more.push(of),
            _ => {}
        }
    }
    if klein && second {
        more.extend(points().map(Quantity::Acceleration));
        let of = |link: LinkId| match mechanism.link(link).points[..] {
            [a, b, ..] if placed(&a) && placed(&b) && !mechanism.is_fixed(a) && !mechanism.is_fixed(b) => {
                Some([Quantity::RelativeNormal(b, a), Quantity::RelativeNormal(a, b)])
            }
            _ => None,
        };
        more.extend(mechanism.moving().filter_map(of).flatten());
    }
    for quantity in shown.chain(vectors).chain(angles).chain(centres).chain(more) {
        if !all.iter().any(|known| known.quantity == quantity) {
            let (name, unit) = (quantity.name(mechanism), unit(scene, quantity));
            all.push(Asked { name, quantity, unit, method: Method::Polygon });
        }
    }
    all
}

/// Angles are told in degrees whatever the scene counts in.
fn unit(scene: &Scene, quantity: Quantity) -> Unit {
    match quantity {
        Quantity::Angle(_) => Unit { symbol: "deg".to_owned(), si: PI / 180.0 },
        _ => crate::scene::unit_of(&quantity, scene),
    }
}
