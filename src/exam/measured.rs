//! What a hand measures where forces are balanced: the arms of moments, friction circles, the sides of polygons.

use super::Flaw;
use crate::graphical::Paper;
use crate::graphical::construction::{About, Construction, Turning};
use crate::mechanism::force::{Action, Force, Party, Share};
use crate::mechanism::friction::{RubbedBy, RubbingPair};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::scene::Scene;

/// What is shorter on paper is not measured well enough, mm.
const SHORTEST: f64 = 2.0;
/// Friction circles smaller than this are shown enlarged, mm.
const ENLARGED: f64 = 1.0;

/// A length that is measured.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Length {
    /// The distance of the mass centre of a link from the line of its inertia force.
    Offset(LinkId),
    /// The arm of a force in the moments of some bodies, the first of them named; about a point of the mechanism, or
    /// about the meet of two lines.
    Arm(Option<LinkId>, Option<PointId>, Turned),
    /// The radius of a friction circle.
    Circle(PointId),
    /// A side of the polygon of a body; of all bodies where none is named.
    Side(Option<Party>, Action),
}

/// What is turned by an arm.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Turned {
    Whole(Action),
    Along(Action),
    Across(Action),
}

/// All that is measured of the forces of a solution, and how its pairs rub.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Measured {
    /// With its name and its length on paper, mm.
    lengths: Vec<(Length, String, f64)>,
    /// Each pair with its name, and whether it moves in the positive sense.
    senses: Vec<(RubbingPair, String, bool)>,
}

impl Measured {
    /// Of a solution on this paper.
    pub(super) fn of(scene: &Scene, construction: &Construction, paper: Paper) -> Self {
        let Some(sheet) = &construction.forces else { return Self::default() };
        let mechanism = &scene.mechanism;
        let per_mm = construction.space.metres_per_mm;
        let mut lengths: Vec<(Length, String, f64)> = Vec::new();
        let offsets = sheet.bodies.iter().flat_map(|body| &body.acting);
        for acting in offsets.filter(|acting| !acting.with_couple) {
            let Action::Inertia(link) = acting.action else { continue };
            let away = libm::hypot(acting.through[0] - acting.at[0], acting.through[1] - acting.at[1]);
            let name = Quantity::Force(Force::Offset(link), Share::Total).name(mechanism);
            lengths.push((Length::Offset(link), name, away / per_mm));
        }
        for balance in &sheet.moments {
            let link = balance.links.first().copied();
            for term in balance.terms.iter().chain([&balance.found]) {
                let turned = match term.of {
                    Turning::Force(action) => Turned::Whole(action),
                    Turning::Along(action) => Turned::Along(action),
                    Turning::Across(action) => Turned::Across(action),
                    Turning::Torque(_) => continue,
                };
                let (Turned::Whole(action) | Turned::Along(action) | Turned::Across(action)) = turned;
                let Some(arm) = &term.arm else { continue };
                let about = match balance.about {
                    About::Point(point) | About::Contact { pin: point, .. } => Some(point),
                    About::Meet { .. } | About::Centre { .. } => None,
                };
                let other = if matches!(balance.about, About::Centre { .. }) { "I" } else { "K" };
                let told = about.map_or(other, |point| &mechanism.point(point).name);
                let name = format!("arm({},{told})", action.name(mechanism));
                lengths.push((Length::Arm(link, about, turned), name, arm.length / per_mm));
            }
        }
        if let Some(newtons) = paper.force {
            let bodies = sheet.bodies.iter().map(|body| (Some(body.of), &body.acting));
            for (of, acting) in bodies.chain([(None, &sheet.whole)]) {
                for side in acting {
                    let mm = libm::hypot(side.force[0], side.force[1]) / newtons;
                    lengths.push((Length::Side(of, side.action), side.action.name(mechanism), mm));
                }
            }
        }
        let mut senses = Vec::new();
        for touch in &sheet.rubs {
            let name = named(mechanism, touch.rub.pair);
            if let (RubbingPair::Pin { pin, .. }, RubbedBy::Circle(radius)) = (touch.rub.pair, touch.rub.by)
                && radius / per_mm >= ENLARGED
            {
                lengths.push((
                    Length::Circle(pin),
                    format!("the friction circle at {name}"),
                    radius / per_mm,
                ));
            }
            senses.push((touch.rub.pair, name, touch.rub.forward));
        }
        Self { lengths, senses }
    }

    /// Whether a variant with these lengths may be drawn by hand as this scene is: what is long enough to be measured here
    /// is so there, and what rubs, rubs in the same sense.
    pub(super) fn suits(&self, variant: &Self) -> Result<(), Flaw> {
        for (pair, what, forward) in &variant.senses {
            if self.senses.iter().any(|(own, _, sense)| own == pair && sense != forward) {
                return Err(Flaw::OtherSense { what: what.clone() });
            }
        }
        for (length, what, mm) in variant.lengths.iter().filter(|(.., mm)| *mm < SHORTEST) {
            let short = |(own, _, mm): &(Length, String, f64)| own == length && *mm < SHORTEST;
            // What does not act in the scene has no side there.
            let absent = matches!(length, Length::Side(..) | Length::Arm(..) | Length::Offset(_))
                && !self.lengths.iter().any(|(own, ..)| own == length)
                && *mm == 0.0;
            if !absent && !self.lengths.iter().any(short) {
                return Err(Flaw::Short { what: what.clone(), mm: *mm });
            }
        }
        Ok(())
    }
}

fn named(mechanism: &Mechanism, pair: RubbingPair) -> String {
    match pair {
        RubbingPair::Pin { pin, .. } => mechanism.point(pin).name.clone(),
        RubbingPair::Slide(slide) => match mechanism.pin_of_slide(slide) {
            Some(point) => format!("the guide of {}", mechanism.point(point).name),
            None => format!("slides[{slide}]"),
        },
    }
}
