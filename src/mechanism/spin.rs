//! Governors: a plane that turns about an axis in it, with all that stands in the plane.

use super::force::{Action, Party, Share, SpringKind};
use super::{Given, GivenPoint, Input, LinkId, Mechanism};

/// The whole plane turns about an axis in it. Every mass is a point at its mass centre and is driven away from the axis
/// by M ω² r.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spin {
    /// A point of the axis.
    pub through: GivenPoint,
    /// Its direction from +x, radians.
    pub angle: Given,
    /// How fast the plane turns.
    pub omega: SpinSpeed,
    /// Of so many equal halves one is drawn.
    pub balls: u32,
    /// The link that all halves share: what acts on it counts a part in the half that is drawn.
    pub sleeve: Option<LinkId>,
    /// A constant force against the sliding of the sleeve.
    pub drag: Option<Drag>,
    /// The inputs rest, and one of them moves at a unit rate only in order to say in which senses pairs rub once the sleeve is
    /// about to move.
    pub imagined: bool,
}

/// A speed of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpinSpeed {
    /// rad/s.
    Given(Given),
    /// That of equilibrium, to be found.
    Sought,
}

/// A force against the sliding of the sleeve, whatever presses it against its guide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drag {
    /// Index of the sliding pair in which the sleeve rides.
    pub slide: usize,
    /// Newtons, on the whole sleeve.
    pub size: Given,
}

impl Spin {
    /// In which sense the sleeve moves along its guide, where a share or the input says so: +1 or −1.
    #[must_use]
    pub fn sense(&self, share: Share, mechanism: &Mechanism) -> Option<f64> {
        match share {
            Share::Rising => return Some(1.0),
            Share::Falling => return Some(-1.0),
            Share::Total | Share::Static | Share::Inertia => {}
        }
        if self.imagined {
            return None;
        }
        let of_sleeve = |slide: usize| self.drag.is_some_and(|drag| drag.slide == slide);
        mechanism.inputs.iter().find_map(|input| match input {
            Input::Slide { slide, velocity, .. } if of_sleeve(*slide) && velocity.value != 0.0 => {
                Some(velocity.value.signum())
            }
            _ => None,
        })
    }

    /// How many halves share what acts on a link.
    #[must_use]
    pub fn shared_by(&self, link: LinkId) -> f64 {
        if self.sleeve == Some(link) { f64::from(self.balls) } else { 1.0 }
    }
}

impl Mechanism {
    /// Whether this is a governor whose inputs rest: nothing moves in its own plane.
    #[must_use]
    pub fn rests_in_its_plane(&self) -> bool {
        let rests = |input: &Input| match input {
            Input::Angle { omega, alpha, .. } => omega.value == 0.0 && alpha.value == 0.0,
            Input::Speed { speed, alpha, .. } => speed.value == 0.0 && alpha.value == 0.0,
            Input::Slide { velocity, acceleration, .. } => velocity.value == 0.0 && acceleration.value == 0.0,
        };
        self.forces.spin.is_some_and(|spin| spin.imagined || self.inputs.iter().all(rests))
    }

    /// The sliding pair in which the sleeve of a governor rides on the frame.
    #[must_use]
    pub fn sleeve_slide(&self) -> Option<usize> {
        let sleeve = self.forces.spin?.sleeve?;
        let of_sleeve = |pair: &super::Slide| {
            pair.guide.link == LinkId::FRAME && self.party_of(&pair.rider) == Party::Link(sleeve)
        };
        let straight = |pair: &super::Slide| matches!(pair.guide.path, super::Path::Straight { .. });
        self.slides.iter().position(|pair| of_sleeve(pair) && straight(pair))
    }

    /// How many equal halves share what acts on a link: more than one only of the sleeve of a governor.
    #[must_use]
    pub fn shared_by(&self, link: LinkId) -> f64 {
        self.forces.spin.map_or(1.0, |spin| spin.shared_by(link))
    }

    /// How many halves share a force: of a load, a weight, a spring, inertia, a drag.
    #[must_use]
    pub fn halves_of(&self, action: Action) -> f64 {
        match action {
            Action::Spring { index, .. } => {
                let ends = match self.forces.springs[index].kind {
                    SpringKind::Pull(ends) => ends.map(|(link, _)| link),
                    SpringKind::Torsion(links) => links,
                };
                ends.into_iter().map(|link| self.shared_by(link)).fold(1.0, f64::max)
            }
            Action::Drag(_) => {
                self.forces.spin.and_then(|spin| spin.sleeve).map_or(1.0, |of| self.shared_by(of))
            }
            Action::Load(index) => self.shared_by(self.forces.loads[index].link),
            Action::Weight(link) | Action::Inertia(link) | Action::Centrifugal(link) => self.shared_by(link),
            _ => 1.0,
        }
    }
}
