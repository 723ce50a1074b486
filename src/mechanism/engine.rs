//! Engines: slider-cranks with a driven crank. A crank on a fixed pivot, a rod, and its pin on a straight guide of the
//! frame.

use super::quantity::Quantity;
use super::structure::{Drive, GroupKind, Structure};
use super::{Input, LinkId, Mechanism, Path, PointId};

/// A slider-crank whose crank is driven: what Klein's construction starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Engine {
    /// The crank.
    pub crank: LinkId,
    /// Its fixed pivot.
    pub pivot: PointId,
    /// Index into [`Mechanism::inputs`]: what drives it.
    pub input: usize,
    /// The pin between crank and rod.
    pub crank_pin: PointId,
    /// The connecting rod.
    pub rod: LinkId,
    /// The pin of the rod on the guide.
    pub slider_pin: PointId,
    /// Index into [`Mechanism::slides`]: the guide.
    pub slide: usize,
}

impl Engine {
    /// Every slider-crank of a mechanism, in order of transmission.
    #[must_use]
    pub fn all(mechanism: &Mechanism, structure: &Structure) -> Vec<Self> {
        let crank_with = |pin: PointId| {
            structure.groups.iter().find_map(|group| match group.kind {
                GroupKind::Driver { base, input: Drive::Input(input) } if mechanism.is_fixed(base) => {
                    let (Input::Angle { link, .. } | Input::Speed { link, .. }) = mechanism.inputs[input]
                    else {
                        return None;
                    };
                    let carries = link != LinkId::FRAME && mechanism.link(link).points.contains(&pin);
                    (carries && pin != base).then_some((link, base, input))
                }
                _ => None,
            })
        };
        let of = |kind: GroupKind| {
            let GroupKind::Rrp { rod, base: crank_pin, pin: slider_pin, slide, rider } = kind else {
                return None;
            };
            let guide = mechanism.slides[slide].guide;
            let straight = guide.link == LinkId::FRAME && matches!(guide.path, Path::Straight { .. });
            let (crank, pivot, input) = crank_with(crank_pin)?;
            (straight && rider.is_none()).then_some(Self {
                crank,
                pivot,
                input,
                crank_pin,
                rod,
                slider_pin,
                slide,
            })
        };
        structure.groups.iter().filter_map(|group| of(group.kind)).collect()
    }

    /// The slider-crank that has the moving points and links of a quantity; `None` where none has.
    #[must_use]
    pub fn with(mechanism: &Mechanism, structure: &Structure, quantity: &Quantity) -> Option<Self> {
        Self::all(mechanism, structure).into_iter().find(|crank| crank.leads_to(quantity))
    }

    /// Whether the quantity is one of its two pins, of one against the other, or of the rod.
    #[must_use]
    pub fn leads_to(&self, quantity: &Quantity) -> bool {
        let pin = |p: PointId| p == self.crank_pin || p == self.slider_pin;
        match *quantity {
            Quantity::Velocity(p) | Quantity::Acceleration(p) => pin(p),
            Quantity::RelativeVelocity(b, a) | Quantity::RelativeAcceleration(b, a) => {
                pin(a) && pin(b) && a != b
            }
            Quantity::Omega(link) | Quantity::Alpha(link) => link == self.rod,
            _ => false,
        }
    }
}
