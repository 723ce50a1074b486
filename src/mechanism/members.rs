//! Of how many forces a link is in balance: two run along one line, three through one point.

use super::force::{Heaviness, Inertia, LoadKind, Party, SpringKind};
use super::{Input, LinkId, Mechanism};

impl Mechanism {
    /// How many forces act on a link, through its pairs and from outside; none where a torque acts on it besides, or where
    /// it is the frame.
    #[must_use]
    pub fn forces_on(&self, link: LinkId) -> Option<usize> {
        if link == LinkId::FRAME || self.is_turned(link) {
            return None;
        }
        let forces = &self.forces;
        let pins = self.link(link).points.iter().filter(|pin| self.is_pin(**pin)).count();
        let slides = self
            .slides
            .iter()
            .filter(|slide| slide.guide.link == link || self.party_of(&slide.rider) == Party::Link(link));
        let rolls = self.rolls.iter().filter(|roll| roll.bodies().contains(&link)).count();
        let loads = forces.loads.iter().filter(|load| load.link == link).count();
        let springs = forces.springs.iter().filter(|spring| match spring.kind {
            SpringKind::Pull(ends) => ends.iter().any(|(of, _)| *of == link),
            SpringKind::Torsion(_) => false,
        });
        let drives = self.inputs.iter().filter(|input| match input {
            Input::Slide { slide, .. } => {
                let slide = &self.slides[*slide];
                forces_are_sought_at_inputs(self)
                    && (slide.guide.link == link || self.party_of(&slide.rider) == Party::Link(link))
            }
            Input::Angle { .. } | Input::Speed { .. } => false,
        });
        // Inertia shifted by its couple is one force; about a fixed mass centre it is a torque, and only a weight acts.
        let mass = match forces.mass(link) {
            None => 0,
            Some(mass) if mass.heaviness == Heaviness::None => return None,
            Some(mass) if self.is_fixed(mass.centre) => match mass.inertia {
                Inertia::Point => usize::from(forces.gravity.acts),
                _ => return None,
            },
            Some(_) => 1 + usize::from(forces.gravity.acts),
        };
        Some(pins + slides.count() + rolls + loads + springs.count() + drives.count() + mass)
    }

    /// Whether a torque acts on a link: an effort, a load, a torsion spring.
    fn is_turned(&self, link: LinkId) -> bool {
        let forces = &self.forces;
        let driven = (0..self.inputs.len()).any(|input| self.driven_link(input) == Some(link));
        let loaded =
            forces.loads.iter().any(|load| load.link == link && matches!(load.kind, LoadKind::Torque { .. }));
        let twisted = forces.springs.iter().any(|spring| match spring.kind {
            SpringKind::Torsion(links) => links.contains(&link),
            SpringKind::Pull(_) => false,
        });
        (driven && forces_are_sought_at_inputs(self)) || loaded || twisted
    }
}

/// Whether inputs have efforts of their own.
fn forces_are_sought_at_inputs(mechanism: &Mechanism) -> bool {
    mechanism.named_sought().is_empty()
}
