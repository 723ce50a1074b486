//! What rubs: journals in their pins, riders on their guides.
//!
//! As everywhere in this room the numbers stand as they were given: a coefficient stays a coefficient, an angle of
//! friction an angle, and the radius of a friction circle is derived by each solver for itself.

use super::force::{Party, Through};
use super::{Given, LinkId, Mechanism, PointId};

/// Everything that rubs; empty where the scene says nothing of friction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Friction {
    /// Pins, in the order of the scene.
    pub pins: Vec<RubbingPin>,
    /// Sliding pairs, in their order.
    pub slides: Vec<RubbingSlide>,
}

/// How rough a pair is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Roughness {
    /// The coefficient of friction, tan φ; positive.
    Coefficient(Given),
    /// The angle of friction φ, radians, between 0 and π/2.
    Angle(Given),
}

impl Roughness {
    /// The angle of friction, radians, to look at.
    #[must_use]
    pub fn angle(self) -> f64 {
        match self {
            Self::Coefficient(f) => libm::atan(f.value),
            Self::Angle(angle) => angle.value,
        }
    }
}

/// The friction circle of a pin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FrictionCircle {
    /// Its radius, metres.
    Radius(Given),
    /// A journal of this radius, metres, that rubs so: r sin φ.
    Journal {
        /// Radius of the journal.
        radius: Given,
        /// How it rubs.
        roughness: Roughness,
    },
}

impl FrictionCircle {
    /// Its radius, metres, to look at.
    #[must_use]
    pub fn radius(self) -> f64 {
        match self {
            Self::Radius(radius) => radius.value,
            Self::Journal { radius, roughness } => radius.value * libm::sin(roughness.angle()),
        }
    }
}

/// A pin that rubs: every link of it against the one that carries it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RubbingPin {
    /// The pin.
    pub pin: PointId,
    /// The circle that the forces touch.
    pub circle: FrictionCircle,
}

/// What resists sliding.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Resistance {
    /// The force leans by the angle of friction.
    Friction(Roughness),
    /// A constant force against sliding, newtons, positive.
    Drag(Given),
    /// Both.
    Both(Roughness, Given),
}

impl Resistance {
    /// How rough the guide is.
    #[must_use]
    pub fn roughness(self) -> Option<Roughness> {
        match self {
            Self::Friction(roughness) | Self::Both(roughness, _) => Some(roughness),
            Self::Drag(_) => None,
        }
    }

    /// The constant force.
    #[must_use]
    pub fn drag(self) -> Option<Given> {
        match self {
            Self::Drag(drag) | Self::Both(_, drag) => Some(drag),
            Self::Friction(_) => None,
        }
    }
}

/// A sliding pair that rubs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RubbingSlide {
    /// Index of the sliding pair.
    pub slide: usize,
    /// What resists.
    pub resistance: Resistance,
}

/// Two links that rub on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum RubbingPair {
    /// At a pin.
    Pin {
        /// The pin.
        pin: PointId,
        /// The link that carries it.
        carrier: LinkId,
        /// The link that turns on it.
        link: LinkId,
    },
    /// In a sliding pair, by its index.
    Slide(usize),
}

/// In which sense a pair moves, which is what friction is against.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Rub {
    /// The pair.
    pub pair: RubbingPair,
    /// What it is that the force leans by or touches.
    pub by: RubbedBy,
    /// The link turns ccw on its carrier, or the rider moves along the direction of its guide.
    pub forward: bool,
}

/// By what a force is moved or turned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RubbedBy {
    /// The radius of the friction circle that the force touches, metres.
    Circle(f64),
    /// The angle by which it leans from the normal, radians.
    Angle(f64),
    /// A constant force against sliding, newtons.
    Drag(f64),
}

impl Friction {
    /// Whether nothing rubs.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.pins.is_empty() && self.slides.is_empty()
    }

    /// The circle of a pin.
    #[must_use]
    pub fn circle(&self, pin: PointId) -> Option<FrictionCircle> {
        self.pins.iter().find(|rubbing| rubbing.pin == pin).map(|rubbing| rubbing.circle)
    }

    /// The angle of friction at a part of its full strength, radians; none of a drag.
    #[must_use]
    pub fn angle_at(&self, pair: RubbingPair, part: f64) -> Option<f64> {
        match pair {
            RubbingPair::Pin { pin, .. } => match self.circle(pin)? {
                FrictionCircle::Journal { roughness, .. } => {
                    Some(libm::asin((part * libm::sin(roughness.angle())).min(1.0)))
                }
                FrictionCircle::Radius(_) => None,
            },
            RubbingPair::Slide(slide) => {
                let angle = self.resistance(slide)?.roughness()?.angle();
                Some(libm::atan(part * libm::tan(angle)))
            }
        }
    }

    /// What resists in a sliding pair.
    #[must_use]
    pub fn resistance(&self, slide: usize) -> Option<Resistance> {
        self.slides.iter().find(|rubbing| rubbing.slide == slide).map(|rubbing| rubbing.resistance)
    }
}

impl Mechanism {
    /// The link in which a pin that rubs stands still: who carries it, or the lower of its two links, between which it is
    /// the same.
    #[must_use]
    pub fn rubbing_carrier(&self, pin: PointId) -> Option<LinkId> {
        let links = &self.point(pin).links;
        self.carrier(pin).or(match links[..] {
            [one, _] if self.parties_at(pin).len() == 2 => Some(one),
            _ => None,
        })
    }

    /// Every two links that rub on each other: at the pins, then in the sliding pairs.
    #[must_use]
    pub fn rubbing_pairs(&self) -> Vec<RubbingPair> {
        let friction = &self.forces.friction;
        let mut pairs = Vec::new();
        for RubbingPin { pin, .. } in &friction.pins {
            let Some(carrier) = self.rubbing_carrier(*pin) else { continue };
            let others = self.point(*pin).links.iter().filter(|link| **link != carrier);
            pairs.extend(others.map(|link| RubbingPair::Pin { pin: *pin, carrier, link: *link }));
        }
        pairs.extend(friction.slides.iter().map(|rubbing| RubbingPair::Slide(rubbing.slide)));
        pairs
    }

    /// The links of a pair that rubs; of a pin in a bare slot all that have the pin.
    #[must_use]
    pub fn rubbing_links(&self, pair: RubbingPair) -> Vec<LinkId> {
        match pair {
            RubbingPair::Pin { carrier, link, .. } => vec![carrier, link],
            RubbingPair::Slide(slide) => {
                let pair = &self.slides[slide];
                match self.party_of(&pair.rider) {
                    Party::Link(rider) => vec![pair.guide.link, rider],
                    Party::Pin(pin) => {
                        let links = self.point(pin).links.iter().copied();
                        std::iter::once(pair.guide.link).chain(links).collect()
                    }
                }
            }
        }
    }

    /// The joint through which the forces of a pair that rubs pass.
    #[must_use]
    pub fn rubbing_through(&self, pair: RubbingPair) -> Through {
        match pair {
            RubbingPair::Pin { pin, .. } => Through::Pin(pin),
            RubbingPair::Slide(slide) => match self.party_of(&self.slides[slide].rider) {
                Party::Pin(pin) => Through::Pin(pin),
                Party::Link(_) => Through::Slide(slide),
            },
        }
    }

    /// A pair that rubs, as one says it.
    #[must_use]
    pub fn say_rubbing(&self, pair: RubbingPair) -> String {
        match pair {
            RubbingPair::Pin { pin, carrier, link } => {
                let (a, b) = (self.link(carrier).number, self.link(link).number);
                format!("the pin {} of links {a} and {b}", self.point(pin).name)
            }
            RubbingPair::Slide(slide) => {
                let on = self.link(self.slides[slide].guide.link).number;
                match self.pin_of_slide(slide) {
                    Some(point) => format!("the slide of {} on link {on}", self.point(point).name),
                    None => format!("a slide on link {on}"),
                }
            }
        }
    }

    /// That friction locks in these pairs, at a part of what is stated.
    #[must_use]
    pub fn say_locked(&self, pairs: &[RubbingPair], part: f64) -> String {
        let names: Vec<String> = pairs
            .iter()
            .map(|pair| match self.forces.friction.angle_at(*pair, part) {
                Some(angle) => {
                    format!("{} (friction angle {:.4} deg)", self.say_rubbing(*pair), angle.to_degrees())
                }
                None => self.say_rubbing(*pair),
            })
            .collect();
        format!(
            "locked: with friction no balance exists; it locks at {part:.4} of the stated friction in {}",
            names.join(", ")
        )
    }

    /// That two balances fit.
    #[must_use]
    pub fn say_several(&self, pairs: &[RubbingPair]) -> String {
        let names: Vec<String> = pairs.iter().map(|pair| self.say_rubbing(*pair)).collect();
        format!("ambiguous: two balances with friction fit; what rubs is {}", names.join(", "))
    }

    /// The name of the point by which one tells a pair that rubs.
    #[must_use]
    pub fn rubbing_name(&self, pair: RubbingPair) -> Option<&str> {
        let point = match pair {
            RubbingPair::Pin { pin, .. } => Some(pin),
            RubbingPair::Slide(slide) => self.pin_of_slide(slide),
        };
        point.map(|point| self.point(point).name.as_str())
    }

    /// The pin that rides in a sliding pair, or the first joint of the link that does.
    #[must_use]
    pub fn pin_of_slide(&self, slide: usize) -> Option<PointId> {
        match self.slides[slide].rider {
            super::Rider::Pin { point, .. } => Some(point),
            super::Rider::Link { link, .. } => self.link(link).points.first().copied(),
        }
    }
}
