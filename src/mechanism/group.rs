//! What a group is: which links it has and how they hang together, the image that is sought with it, and the two
//! unknowns that lead there. Plan, velocity and acceleration read that; the name of a kind is for people.

use std::fmt;

use super::structure::Drive;
use super::{LinkId, Mechanism, PointId, Rider};

/// The kinds of groups by the constructions that solve them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum GroupKind {
    /// A link driven about a pin on a link that is already solved.
    Driver {
        /// Its pin on a solved link.
        base: PointId,
        /// What says how it turns.
        input: Drive,
    },
    /// Two links, three turning pairs.
    Rrr {
        /// The two links.
        links: [LinkId; 2],
        /// Their pins on solved links.
        bases: [PointId; 2],
        /// The pin between them.
        pin: PointId,
    },
    /// A rod whose pin rides on a guide of a solved link.
    Rrp {
        /// The rod.
        rod: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// The pin on the guide.
        pin: PointId,
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// The link that has the pin and slides without turning against the solved one, where it is not
        /// the pin itself or its block that slides.
        rider: Option<LinkId>,
    },
    /// A lever that carries a guide for a pin of a solved link (slotted lever, Whitworth); or that
    /// carries, or is carried by, a rod which slides against it without turning (oscillating cylinder).
    Rpr {
        /// The link about whose pin the group turns.
        lever: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// The pin on the solved link that rides on the guide.
        pin: PointId,
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// The rod between the pin and the guide, where there is one.
        rod: Option<LinkId>,
    },
    /// A pin that rides on guides of two solved links, itself or with a link that slides without turning; or a link that
    /// slides without turning against both, which turn as one, with its first joint.
    Prp {
        /// The pin.
        pin: PointId,
        /// Indices into [`Mechanism::slides`].
        slides: [usize; 2],
        /// For each pair the link that has the pin and slides without turning against the solved one, where
        /// it is not the pin itself or its block that slides.
        riders: [Option<LinkId>; 2],
    },
    /// A link that slides without turning against a solved link, and another that slides without turning
    /// against the first and is pinned to a solved link (Oldham's coupling).
    Rpp {
        /// The link between the two sliding pairs.
        link: LinkId,
        /// Its first joint, by which it is found.
        point: PointId,
        /// The pinned link.
        lever: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// Index into [`Mechanism::slides`]: the link and the solved link.
        ride: usize,
        /// Index into [`Mechanism::slides`]: the link and the pinned link.
        slot: usize,
    },
    /// A link that slides without turning against a solved link and carries a guide for a pin of a
    /// solved link (Scotch yoke).
    Yoke {
        /// The link.
        link: LinkId,
        /// Index into [`Mechanism::slides`]: the link and the solved link.
        ride: usize,
        /// The pin on the solved link.
        pin: PointId,
        /// Index into [`Mechanism::slides`]: the pin on the link.
        slot: usize,
    },
    /// A slide that is driven: its pin, or the link that rides without turning.
    DrivenSlide {
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// What says how it slides.
        input: Drive,
    },
    /// A wheel pivoted to a solved link and rolling on another.
    Wheel {
        /// The wheel.
        wheel: LinkId,
        /// Its centre, pinned to a solved link.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
    /// A link that slides without turning against a solved link and is driven by a solved wheel.
    Rack {
        /// The link.
        link: LinkId,
        /// Index into [`Mechanism::slides`]: the link and the solved link.
        ride: usize,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
    /// A driven link that two pairs hold: its pins ride on guides of solved links, themselves or with links that slide
    /// without turning (trammel driven by its bar); or it carries guides for pins of solved links; or a centre or a
    /// line of it is held against a solved body; or its pins are those of rods on solved links (a four-bar driven by its
    /// coupler).
    DrivenBar {
        /// The link.
        link: LinkId,
        /// The point of it by which it is found: the first of its own pins, else its first joint.
        point: PointId,
        /// The pins: of the link, or solved ones under which its guides run; its own first.
        pins: [PointId; 2],
        /// For each pin what holds it.
        holds: [Hold; 2],
        /// For each pin the link that has it and slides without turning against the solved one, where it is
        /// not the pin itself or its block that slides.
        riders: [Option<LinkId>; 2],
        /// For each pin whether it is solved and rides on a guide of the link, or is the centre of a wheel against which
        /// a line of the link is held.
        under: [bool; 2],
        /// What says how it turns.
        input: Drive,
    },
    /// A driven wheel that rolls on a solved body; its centre is held by the contact, or rides on a guide.
    DrivenWheel {
        /// The wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// Index into [`Mechanism::slides`]: the centre on a guide of a solved link.
        guide: Option<usize>,
        /// What says how it turns.
        input: Drive,
    },
    /// A wheel on an arm that rolls on two solved bodies about the arm's own pin (planet between sun and ring): their speeds
    /// tell those of both.
    Planet {
        /// The arm.
        arm: LinkId,
        /// Its pin on a solved link, about which both bodies have their circles.
        base: PointId,
        /// The wheel.
        wheel: LinkId,
        /// Its centre, on the arm.
        centre: PointId,
        /// Indices into [`Mechanism::rolls`].
        rolls: [usize; 2],
    },
    /// A rod that carries the centre of a wheel, which is held against a solved body.
    Rolling {
        /// The rod.
        rod: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// The wheel; how it turns is found after it.
        wheel: LinkId,
        /// The wheel's centre, on the rod.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
    /// A link that slides without turning against a solved link and carries a centre, which is held against a solved
    /// body.
    RidingCentre {
        /// The link.
        link: LinkId,
        /// Index into [`Mechanism::slides`]: the link and the solved link.
        ride: usize,
        /// The wheel of that centre: the link, or one that is pinned there.
        wheel: LinkId,
        /// The centre, on the link.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
    /// A wheel's centre that two contacts with solved bodies hold, or a contact and a guide of a solved link.
    HeldCentre {
        /// The centre.
        centre: PointId,
        /// What holds it: contacts, or the sliding pair in which it rides.
        holds: [Hold; 2],
    },
    /// A link whose own line is held against a wheel whose centre is solved (a rack pinned to a crank).
    PinnedRack {
        /// The link.
        link: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// The wheel; how it turns is found after it.
        wheel: LinkId,
        /// The wheel's centre, solved.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
    /// A pin that a lever about a solved pin holds at the distance to which it is driven along the lever (hydraulic
    /// cylinder), and that is held besides: by a rod, by another such lever, or by a guide of a solved link.
    Driven {
        /// The pin.
        pin: PointId,
        /// What holds it; a driven lever first.
        holds: [Hold; 2],
        /// For each hold the link that has the pin and slides without turning, where it is not the pin itself or its block
        /// that slides.
        riders: [Option<LinkId>; 2],
    },
    /// A driven link whose own line rolls on a wheel that is solved: nothing else holds it.
    DrivenRack {
        /// The link.
        link: LinkId,
        /// The wheel.
        wheel: LinkId,
        /// The wheel's centre.
        centre: PointId,
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// What says how it turns.
        input: Drive,
    },
    /// A group of higher class: something in it is driven by trial until the group closes.
    Higher {
        /// Index into [`Structure::trials`](super::structure::Structure::trials).
        trial: usize,
    },
    /// A group for which no construction is known yet.
    Other,
}

/// A lever about a solved pin, along which another pin is driven.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Ram {
    /// The lever: it carries the guide, or it is the rod that slides on the guide of what has the driven pin.
    pub lever: LinkId,
    /// Its pin on a solved link.
    pub base: PointId,
    /// Index into [`Mechanism::slides`].
    pub slide: usize,
    /// Index into [`Mechanism::inputs`].
    pub input: usize,
}

impl Ram {
    /// Whether the lever slides, and its partner carries the guide: then the driven pin moves against the lever as the guide
    /// against the rider.
    #[must_use]
    pub fn slides(self, mechanism: &Mechanism) -> bool {
        matches!(mechanism.slides[self.slide].rider, Rider::Link { link, .. } if link == self.lever)
    }
}

/// What holds a pin of a driven link.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Hold {
    /// A sliding pair; index into [`Mechanism::slides`].
    Slide(usize),
    /// A rolling contact of which the pin is a centre.
    Contact {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// The wheel about that centre.
        wheel: LinkId,
    },
    /// A rod between it and a solved link.
    Rod {
        /// The rod.
        rod: LinkId,
        /// Its pin on a solved link.
        base: PointId,
    },
    /// A lever along which it is driven.
    Ram(Ram),
}

impl Hold {
    /// The sliding pair, where it is one.
    #[must_use]
    pub const fn slide(self) -> Option<usize> {
        match self {
            Self::Slide(slide) => Some(slide),
            Self::Contact { .. } | Self::Rod { .. } | Self::Ram(_) => None,
        }
    }

    /// The rod and its pin on a solved link, where it is one.
    #[must_use]
    pub const fn rod(self) -> Option<(LinkId, PointId)> {
        match self {
            Self::Rod { rod, base } => Some((rod, base)),
            Self::Slide(_) | Self::Contact { .. } | Self::Ram(_) => None,
        }
    }

    /// The driven lever, where it is one.
    #[must_use]
    pub const fn ram(self) -> Option<Ram> {
        match self {
            Self::Ram(ram) => Some(ram),
            Self::Slide(_) | Self::Contact { .. } | Self::Rod { .. } => None,
        }
    }

    /// What it leaves unknown of the pin; `back` where what holds is sought and the pin is solved.
    #[must_use]
    pub const fn unknown(self, back: bool, pin: PointId) -> Unknown {
        match self {
            Self::Slide(slide) => Unknown::Slide { slide, back },
            Self::Contact { roll, wheel } => Unknown::Roll { roll, wheel, centre: pin, back },
            Self::Rod { rod, base } => Unknown::Turn { link: rod, base, to: pin },
            Self::Ram(ram) => Unknown::Reach { ram, to: pin },
        }
    }
}

impl fmt::Display for GroupKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Driver { .. } => "driver",
            Self::Rrr { .. } => "RRR",
            Self::Rrp { .. } => "RRP",
            Self::Rpr { .. } => "RPR",
            Self::Prp { .. } => "PRP",
            Self::Rpp { .. } => "RPP",
            Self::Yoke { .. } => "PPR",
            Self::DrivenSlide { .. } => "driven slide",
            Self::Wheel { .. } => "wheel",
            Self::Rack { .. } => "rack",
            Self::DrivenBar { .. } => "driven bar",
            Self::DrivenWheel { .. } => "driven wheel",
            Self::Planet { .. } => "planet on its arm",
            Self::Rolling { .. } => "rod with a rolling wheel",
            Self::PinnedRack { .. } => "pinned rack",
            Self::RidingCentre { .. } => "riding link on a rolling contact",
            Self::HeldCentre { .. } => "centre held by contacts",
            Self::Driven { .. } => "driven cylinder",
            Self::DrivenRack { .. } => "driven rack",
            Self::Higher { .. } => "group of higher class",
            Self::Other => "group without a construction",
        })
    }
}

/// What a group of two unknowns is solved for, at the orders of velocity and acceleration alike.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Target {
    /// The image of the group's pin.
    Pin(PointId),
    /// The image of the point of a link under a pin of a solved link.
    Under(PointId, LinkId),
}

impl Target {
    /// The pin.
    #[must_use]
    pub const fn pin(self) -> PointId {
        match self {
            Self::Pin(pin) | Self::Under(pin, _) => pin,
        }
    }
}

/// What the length along a line to the sought image tells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unknown {
    /// A link turns about its base.
    Turn {
        /// The link.
        link: LinkId,
        /// Its pin on a solved link.
        base: PointId,
        /// The point whose image the line leads to.
        to: PointId,
    },
    /// A lever turns about its base, and a pin is driven along it.
    Reach {
        /// The lever.
        ram: Ram,
        /// The driven pin.
        to: PointId,
    },
    /// A rider slides along its guide.
    Slide {
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// The rider is solved and the guide is sought.
        back: bool,
    },
    /// Another pin of a driven link slides along its guide, or is held by a contact; the link's rotation leads from it
    /// to the pin that is sought.
    Carried {
        /// What holds that pin.
        hold: Hold,
        /// The rider, or the wheel's centre, is solved and the guide or line is sought.
        back: bool,
        /// The driven link.
        link: LinkId,
        /// The other pin.
        pin: PointId,
    },
    /// A wheel's centre runs along the body on which it rolls.
    Roll {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// The wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
        /// The centre is solved and the body of the line is sought.
        back: bool,
    },
    /// The contact points of a rolling pair have one tangential part; they differ along the common normal.
    Contact {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// The body that is sought.
        body: LinkId,
    },
    /// The same, from the contact point to the centre of a wheel that is driven.
    Spin {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// The wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
    },
}

impl Unknown {
    /// The sliding pair along which it lies.
    #[must_use]
    pub const fn slide(self) -> Option<usize> {
        match self {
            Self::Slide { slide, .. } => Some(slide),
            Self::Carried { hold, .. } => hold.slide(),
            Self::Turn { .. }
            | Self::Reach { .. }
            | Self::Roll { .. }
            | Self::Contact { .. }
            | Self::Spin { .. } => None,
        }
    }
}

/// From what the images of a link's further points are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lead {
    /// From the images of two of its points: by the similar figure.
    Image(PointId, PointId),
    /// From that of one, about which it turns at a rate that is known.
    Turning(PointId),
    /// From that of one; the link does not turn against the solved link on which it slides.
    Riding(PointId),
}

impl GroupKind {
    /// What is sought, and the two unknowns that lead to it, those of the frame first; `None` for what has none or more: a
    /// link about a pin, a driven slide, a wheel on its axle, a group that is tried.
    #[must_use]
    pub fn unknowns(self, mechanism: &Mechanism) -> Option<(Target, [Unknown; 2])> {
        let slide = |slide: usize, link: Option<LinkId>| {
            let back = link == Some(mechanism.slides[slide].guide.link);
            Unknown::Slide { slide, back }
        };
        Some(match self {
            Self::Rrr { links, bases, pin } => {
                (Target::Pin(pin), [0, 1].map(|i| Unknown::Turn { link: links[i], base: bases[i], to: pin }))
            }
            Self::Rrp { rod, base, pin, slide: guide, rider } => {
                (Target::Pin(pin), [Unknown::Turn { link: rod, base, to: pin }, slide(guide, rider)])
            }
            Self::Rolling { rod, base, wheel, centre, roll } => (
                Target::Pin(centre),
                [
                    Unknown::Turn { link: rod, base, to: centre },
                    Unknown::Roll { roll, wheel, centre, back: false },
                ],
            ),
            Self::RidingCentre { link, ride, wheel, centre, roll } => (
                Target::Pin(centre),
                [slide(ride, Some(link)), Unknown::Roll { roll, wheel, centre, back: false }],
            ),
            Self::HeldCentre { centre, holds } => {
                (Target::Pin(centre), holds.map(|hold| hold.unknown(false, centre)))
            }
            Self::PinnedRack { link, base, wheel, centre, roll } => (
                Target::Under(centre, link),
                [Unknown::Turn { link, base, to: centre }, Unknown::Roll { roll, wheel, centre, back: true }],
            ),
            Self::Prp { pin, slides, riders } => {
                (Target::Pin(pin), [0, 1].map(|i| slide(slides[i], riders[i])))
            }
            Self::Rpp { link, point, ride, slot, .. } => {
                (Target::Pin(point), [slide(ride, Some(link)), slide(slot, Some(link))])
            }
            Self::Rpr { lever, base, pin, slide: guide, .. } => (
                Target::Under(pin, lever),
                [Unknown::Turn { link: lever, base, to: pin }, slide(guide, Some(lever))],
            ),
            Self::Yoke { link, ride, pin, slot } => {
                (Target::Under(pin, link), [slide(ride, Some(link)), slide(slot, Some(link))])
            }
            Self::Rack { link, ride, roll } => (
                Target::Under(mechanism.contacts[roll], link),
                [slide(ride, Some(link)), Unknown::Contact { roll, body: link }],
            ),
            Self::DrivenBar { link, point, pins, holds, riders, under, .. } => {
                let hold = |i: usize| {
                    let carries_rider = |slide: usize| riders[i] == Some(mechanism.slides[slide].guide.link);
                    let back = under[i] || holds[i].slide().is_some_and(carries_rider);
                    if pins[i] == point && !under[i] {
                        holds[i].unknown(back, point)
                    } else {
                        Unknown::Carried { hold: holds[i], back, link, pin: pins[i] }
                    }
                };
                (Target::Pin(point), [0, 1].map(hold))
            }
            Self::Driven { pin, holds, riders } => {
                let back = |i: usize| {
                    holds[i]
                        .slide()
                        .is_some_and(|slide| riders[i] == Some(mechanism.slides[slide].guide.link))
                };
                (Target::Pin(pin), [0, 1].map(|i| holds[i].unknown(back(i), pin)))
            }
            Self::DrivenRack { link, wheel, centre, roll, .. } => {
                let hold = Hold::Contact { roll, wheel };
                (
                    Target::Under(mechanism.contacts[roll], link),
                    [
                        Unknown::Carried { hold, back: true, link, pin: centre },
                        Unknown::Contact { roll, body: link },
                    ],
                )
            }
            Self::DrivenWheel { wheel, centre, roll, guide, .. } => {
                let held = match guide {
                    Some(guide) => slide(guide, None),
                    None => Unknown::Roll { roll, wheel, centre, back: false },
                };
                (Target::Pin(centre), [held, Unknown::Spin { roll, wheel, centre }])
            }
            Self::Driver { .. }
            | Self::DrivenSlide { .. }
            | Self::Wheel { .. }
            | Self::Planet { .. }
            | Self::Higher { .. }
            | Self::Other => return None,
        })
    }

    /// The points on solved links from which it is solved.
    #[must_use]
    pub fn bases(self) -> Vec<PointId> {
        match self {
            Self::Driver { base, .. }
            | Self::Rrp { base, .. }
            | Self::Rolling { base, .. }
            | Self::Planet { base, .. }
            | Self::PinnedRack { base, .. }
            | Self::Rpp { base, .. }
            | Self::Yoke { pin: base, .. }
            | Self::Wheel { centre: base, .. }
            | Self::DrivenRack { centre: base, .. } => vec![base],
            Self::Rrr { bases, .. } => bases.to_vec(),
            Self::Rpr { base, pin, .. } => vec![base, pin],
            Self::DrivenBar { pins, holds, under, .. } => {
                let base = |i: usize| match holds[i] {
                    Hold::Rod { base, .. } => Some(base),
                    _ => under[i].then_some(pins[i]),
                };
                (0..2).filter_map(base).collect()
            }
            Self::Driven { holds, .. } => {
                let base = |hold: Hold| match hold {
                    Hold::Rod { base, .. } | Hold::Ram(Ram { base, .. }) => Some(base),
                    Hold::Slide(_) | Hold::Contact { .. } => None,
                };
                holds.into_iter().filter_map(base).collect()
            }
            Self::Prp { .. }
            | Self::Rack { .. }
            | Self::RidingCentre { .. }
            | Self::HeldCentre { .. }
            | Self::DrivenWheel { .. }
            | Self::DrivenSlide { .. }
            | Self::Higher { .. }
            | Self::Other => Vec::new(),
        }
    }

    /// The sliding pairs by which it depends on solved links.
    #[must_use]
    pub fn slides(self, mechanism: &Mechanism) -> Vec<usize> {
        match self {
            Self::DrivenSlide { slide, .. } => vec![slide],
            _ => {
                let unknowns = self.unknowns(mechanism).map(|(_, unknowns)| unknowns);
                unknowns.into_iter().flatten().filter_map(Unknown::slide).collect()
            }
        }
    }

    /// The points that are used or found by solving the group itself.
    #[must_use]
    pub fn main_points(self, mechanism: &Mechanism) -> Vec<PointId> {
        let mut points = self.bases();
        if let Self::Planet { centre, .. } = self {
            points.push(centre);
        }
        if let Some((target, unknowns)) = self.unknowns(mechanism) {
            if let Target::Pin(pin) = target {
                points.push(pin);
            }
            points.extend(unknowns.into_iter().filter_map(|unknown| match unknown {
                Unknown::Carried { pin, .. } => Some(pin),
                _ => None,
            }));
        }
        points
    }

    /// From what the images of the further points of one of its links are found.
    #[must_use]
    pub fn lead(self, mechanism: &Mechanism, link: LinkId) -> Option<Lead> {
        // A block turns with the radius of its arc.
        if let Some((_, pin)) = mechanism.arc_of_block(link) {
            return Some(Lead::Turning(pin));
        }
        let own = match self {
            Self::Rpp { lever, base, .. } if link == lever => Some(Lead::Turning(base)),
            Self::Rpr { lever, pin, .. } if link != lever => Some(Lead::Turning(pin)),
            Self::DrivenBar { link: bar, point, .. } if link == bar => Some(Lead::Turning(point)),
            Self::Planet { arm, base, centre, .. } if link == arm => Some(Lead::Image(base, centre)),
            Self::Yoke { pin, .. }
            | Self::Rpp { point: pin, .. }
            | Self::Prp { pin, .. }
            | Self::RidingCentre { centre: pin, .. } => Some(Lead::Riding(pin)),
            Self::Rack { roll, .. } | Self::DrivenRack { roll, .. } => {
                Some(Lead::Riding(mechanism.contacts[roll]))
            }
            Self::Rrp { rider: Some(rider), pin, .. } if rider == link => Some(Lead::Riding(pin)),
            Self::Driven { pin, holds, riders } => (0..2).find_map(|i| match holds[i] {
                Hold::Rod { rod, base } => (rod == link).then_some(Lead::Image(base, pin)),
                Hold::Ram(Ram { lever, base, .. }) if lever == link => Some(Lead::Turning(base)),
                Hold::Ram(_) => (riders[i] == Some(link)).then_some(Lead::Turning(pin)),
                _ => (riders[i] == Some(link)).then_some(Lead::Riding(pin)),
            }),
            Self::DrivenBar { pins, holds, riders, .. } => (0..2).find_map(|i| match holds[i] {
                Hold::Rod { rod, base } => (rod == link).then_some(Lead::Image(base, pins[i])),
                _ => (riders[i] == Some(link)).then_some(Lead::Riding(pins[i])),
            }),
            _ => None,
        };
        // A link that turns: between its base and the pin where that is its own, else about its base.
        own.or_else(|| {
            let (target, unknowns) = self.unknowns(mechanism)?;
            unknowns.into_iter().find_map(|unknown| match (unknown, target) {
                (Unknown::Turn { link: of, base, to }, Target::Pin(_)) if of == link => {
                    Some(Lead::Image(base, to))
                }
                (Unknown::Turn { link: of, base, .. }, Target::Under(..)) if of == link => {
                    Some(Lead::Turning(base))
                }
                _ => None,
            })
        })
    }

    /// Its links that do not turn against a solved link, each with that link.
    #[must_use]
    pub fn riding(self, mechanism: &Mechanism) -> Vec<(LinkId, LinkId)> {
        // Of a pair's two links the other one.
        let carrier = |slide: usize, found: LinkId| match mechanism.slides[slide].rider {
            Rider::Link { link: rider, .. } if found == mechanism.slides[slide].guide.link => rider,
            _ => mechanism.slides[slide].guide.link,
        };
        match self {
            Self::Yoke { link, ride, .. }
            | Self::Rack { link, ride, .. }
            | Self::RidingCentre { link, ride, .. } => {
                vec![(link, carrier(ride, link))]
            }
            Self::Rrp { slide, rider: Some(link), .. } => vec![(link, carrier(slide, link))],
            Self::Prp { slides, riders, .. } => {
                let riders = riders.into_iter().zip(slides);
                riders.filter_map(|(link, slide)| link.map(|link| (link, carrier(slide, link)))).collect()
            }
            Self::DrivenBar { holds, riders, .. } | Self::Driven { holds, riders, .. } => {
                let riders = riders.into_iter().zip(holds);
                riders.filter_map(|(link, hold)| Some((link?, carrier(hold.slide()?, link?)))).collect()
            }
            Self::Rpp { link, lever, ride, .. } => {
                vec![(link, carrier(ride, link)), (lever, carrier(ride, link))]
            }
            _ => Vec::new(),
        }
    }
}
