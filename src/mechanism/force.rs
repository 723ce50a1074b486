//! What acts on the links besides their pairs: weights, loads, springs, and what is sought of them.
//!
//! As everywhere in this room the numbers stand as they were given: a weight stays a weight, a moment of inertia about
//! a pin stays that. Forces are in newtons, masses in kilograms, torques in newton metres, ccw positive.

use super::curve::Curve;
use super::cycle::Cycle;
use super::friction::Friction;
use super::quantity::{Measure, Nature, Order};
use super::spin::{Spin, SpinSpeed};
use super::{Given, Input, LinkId, Mechanism, PointId, Rider};

/// Everything that a scene says of forces; empty where it says nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Forces {
    /// The field of gravity.
    pub gravity: Gravity,
    /// Masses and moments of inertia, at most one entry for each link, in the order of the links.
    pub masses: Vec<Mass>,
    /// Loads, in the order of the scene.
    pub loads: Vec<Load>,
    /// Sizes of loads over the angle of the first input, each of one load.
    pub curves: Vec<Curve>,
    /// Springs, in the order of the scene.
    pub springs: Vec<Spring>,
    /// The link that holds a pin of several links, where the scene names it.
    pub carriers: Vec<(PointId, LinkId)>,
    /// What rubs.
    pub friction: Friction,
    /// Angle of pressure of toothed rolling pairs, radians, by index of the pair; the others are smooth.
    pub pressures: Vec<(usize, Given)>,
    /// The turning-moment diagram.
    pub cycle: Option<Cycle>,
    /// The axis about which the plane turns, of a governor.
    pub spin: Option<Spin>,
}

impl Default for Forces {
    fn default() -> Self {
        let gravity = Gravity { g: Gravity::USUAL, direction: Gravity::DOWN, acts: false };
        Self {
            gravity,
            masses: Vec::new(),
            loads: Vec::new(),
            curves: Vec::new(),
            springs: Vec::new(),
            carriers: Vec::new(),
            friction: Friction::default(),
            pressures: Vec::new(),
            cycle: None,
            spin: None,
        }
    }
}

/// The field of gravity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Gravity {
    /// m/s², positive; weights become masses with it.
    pub g: Given,
    /// Its direction from +x, ccw, radians.
    pub direction: Given,
    /// Whether weights act; otherwise `g` only says how a weight becomes a mass.
    pub acts: bool,
}

impl Gravity {
    /// 9.81 m/s².
    pub const USUAL: Given = Given {
        value: 9.81,
        error: 9.81 * (f64::EPSILON / 2.0),
        low: 0.0,
        low_error: 9.81 * (f64::EPSILON / 2.0),
    };
    /// −90°.
    pub const DOWN: Given = Given {
        value: -std::f64::consts::FRAC_PI_2,
        error: f64::EPSILON / 2.0,
        low: 0.0,
        low_error: f64::EPSILON / 2.0,
    };
}

/// A link's mass as the scene states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Heaviness {
    /// Kilograms.
    Mass(Given),
    /// Newtons; the mass is this over g.
    Weight(Given),
    /// A flywheel: a moment of inertia alone.
    None,
}

/// A link's moment of inertia as the scene states it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Inertia {
    /// A point mass.
    Point,
    /// About the mass centre, kg m².
    Central(Given),
    /// About another point of the link, kg m².
    About(PointId, Given),
    /// Radius of gyration about the mass centre, metres.
    Gyration(Given),
}

/// The mass of a link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mass {
    /// The link.
    pub link: LinkId,
    /// How heavy it is.
    pub heaviness: Heaviness,
    /// Its mass centre, a point of the link.
    pub centre: PointId,
    /// Its moment of inertia.
    pub inertia: Inertia,
}

/// A number that is given or sought.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Size {
    /// Given.
    Given(Given),
    /// Over the angle of the first input: a curve of [`Forces::curves`], by its index.
    Curve(usize),
    /// A pressure on an area, Pa and m².
    Pressure {
        /// The pressure.
        pressure: Pressure,
        /// On what.
        area: Area,
    },
    /// To be found.
    Sought,
}

/// A pressure, Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pressure {
    /// Given.
    Given(Given),
    /// Over the angle of the first input: a curve of [`Forces::curves`], by its index.
    Curve(usize),
}

impl Size {
    /// The curve by which it changes with the angle of the first input, by its index.
    #[must_use]
    pub fn curve(&self) -> Option<usize> {
        match *self {
            Self::Curve(curve) | Self::Pressure { pressure: Pressure::Curve(curve), .. } => Some(curve),
            Self::Given(_) | Self::Pressure { .. } | Self::Sought => None,
        }
    }
}

/// What a pressure acts on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Area {
    /// m².
    Given(Given),
    /// A piston, less its rod; diameters in metres.
    Bore {
        /// Diameter of the piston.
        bore: Given,
        /// Diameter of the rod.
        rod: Option<Given>,
    },
}

/// Where a force points.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Pointing {
    /// An angle from +x of the world, radians.
    World(Given),
    /// From one point to another, turned ccw by radians.
    Between {
        /// The first point.
        from: PointId,
        /// The second point.
        to: PointId,
        /// Radians.
        turned: Given,
    },
    /// An angle in the own coordinates of a link, radians.
    Own {
        /// The link.
        link: LinkId,
        /// Radians.
        angle: Given,
    },
    /// With the velocity of the loaded point, or against it.
    Motion {
        /// With it, not against it.
        with: bool,
    },
}

/// What a load is.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LoadKind {
    /// A size and a direction.
    Force {
        /// The loaded point, of the link.
        at: PointId,
        /// Newtons along the direction.
        size: Size,
        /// Where it points.
        pointing: Pointing,
    },
    /// Components.
    Vector {
        /// The loaded point, of the link.
        at: PointId,
        /// Newtons.
        parts: [Given; 2],
        /// In whose own coordinates; the frame's are the world's.
        of: LinkId,
    },
    /// A torque, ccw positive.
    Torque {
        /// Newton metres.
        size: Size,
        /// With (or against) the link's ω instead of ccw.
        with_motion: Option<bool>,
    },
}

/// A load on a link.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Its name, given or made up: `P`, `load 2`.
    pub name: String,
    /// The loaded link.
    pub link: LinkId,
    /// What it is.
    pub kind: LoadKind,
}

impl Load {
    /// Whether it is to be found.
    #[must_use]
    pub fn is_sought(&self) -> bool {
        matches!(
            self.kind,
            LoadKind::Force { size: Size::Sought, .. } | LoadKind::Torque { size: Size::Sought, .. }
        )
    }

    /// Whether it is a torque, without a point or a direction.
    #[must_use]
    pub fn is_torque(&self) -> bool {
        matches!(self.kind, LoadKind::Torque { .. })
    }

    /// The loaded point; none of a torque.
    #[must_use]
    pub fn at(&self) -> Option<PointId> {
        match self.kind {
            LoadKind::Force { at, .. } | LoadKind::Vector { at, .. } => Some(at),
            LoadKind::Torque { .. } => None,
        }
    }

    /// The curve by which its size changes with the angle of the first input, by its index.
    #[must_use]
    pub fn curve(&self) -> Option<usize> {
        match self.kind {
            LoadKind::Force { size, .. } | LoadKind::Torque { size, .. } => size.curve(),
            LoadKind::Vector { .. } => None,
        }
    }

    /// Whether its direction is that of a motion.
    #[must_use]
    pub fn follows_motion(&self) -> bool {
        matches!(
            self.kind,
            LoadKind::Force { pointing: Pointing::Motion { .. }, .. }
                | LoadKind::Torque { with_motion: Some(_), .. }
        )
    }
}

/// How hard a spring pulls.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringLaw {
    /// Stiffness times what it is longer (or further turned) than free.
    Stiffness {
        /// N/m, or N m/rad.
        stiffness: Size,
        /// Free length, metres, or free angle of the second link against the first, radians.
        free: Given,
    },
    /// Its pull now: newtons, or newton metres on the second link.
    Force(Size),
}

/// Between what a spring acts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SpringKind {
    /// Between two points of two links; pull positive.
    Pull([(LinkId, PointId); 2]),
    /// Between two links that turn against each other.
    Torsion([LinkId; 2]),
}

/// A spring.
#[derive(Debug, Clone, PartialEq)]
pub struct Spring {
    /// Its name, given or made up.
    pub name: String,
    /// Between what it acts.
    pub kind: SpringKind,
    /// How hard it pulls.
    pub law: SpringLaw,
    /// Of a torsion spring with a stiffness, within half a turn of which angle its second link is turned further than
    /// without load, radians: zero in a scene, what has been turned since where a mechanism has moved on from there.
    pub wound: f64,
}

impl Spring {
    /// Whether its force or its stiffness is to be found.
    #[must_use]
    pub fn is_sought(&self) -> bool {
        matches!(
            self.law,
            SpringLaw::Force(Size::Sought) | SpringLaw::Stiffness { stiffness: Size::Sought, .. }
        )
    }
}

/// What balance has to find besides the reactions: as many as there are freedoms.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Sought {
    /// The effort at an input, by its index: the torque of the surroundings on a driven link, the force along the
    /// guide between rider and carrier of a driven slide.
    Effort(usize),
    /// A load, by its index.
    Load(usize),
    /// A spring, by its index.
    Spring(usize),
    /// ω² of the plane of a governor.
    Spin,
}

impl Forces {
    /// Whether the scene says anything of forces.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.masses.is_empty() && self.loads.is_empty() && self.springs.is_empty()
    }

    /// The motion that the forces hang on: inertia on accelerations, a load against a motion on its velocity.
    #[must_use]
    pub fn order(&self) -> Order {
        if !self.masses.is_empty() {
            Order::Acceleration
        } else if self.loads.iter().any(Load::follows_motion) || !self.friction.is_empty() {
            Order::Velocity
        } else {
            Order::Position
        }
    }

    /// Angle of pressure of a rolling pair, radians; none of smooth wheels.
    #[must_use]
    pub fn pressure(&self, roll: usize) -> Option<Given> {
        self.pressures.iter().find(|(of, _)| *of == roll).map(|(_, angle)| *angle)
    }

    /// Where the curves of loads have their knots: an angle, and after which angle it comes again, radians.
    #[must_use]
    pub fn knots(&self) -> Vec<[Given; 2]> {
        let of = |curve: &Curve| match curve {
            Curve::Table { knots, period } => knots.iter().map(|[at, _]| [*at, *period]).collect(),
            Curve::Harmonics { .. } => Vec::new(),
        };
        self.curves.iter().flat_map(of).collect()
    }

    /// The mass of a link.
    #[must_use]
    pub fn mass(&self, link: LinkId) -> Option<&Mass> {
        self.masses.iter().find(|mass| mass.link == link)
    }

    /// Whether the scene states anything that acts on a link besides what its joints exert: a mass, a load, a spring, or the
    /// friction of a sleeve.
    #[must_use]
    pub fn acts_on(&self, link: LinkId) -> bool {
        let sprung = self.springs.iter().any(|spring| match spring.kind {
            SpringKind::Pull(ends) => ends.iter().any(|(of, _)| *of == link),
            SpringKind::Torsion(links) => links.contains(&link),
        });
        let rubbed = self.spin.is_some_and(|spin| spin.sleeve == Some(link) && spin.drag.is_some());
        sprung || rubbed || self.mass(link).is_some() || self.loads.iter().any(|load| load.link == link)
    }
}

impl Mechanism {
    /// What balance has to find besides the reactions: what the scene seeks, or else the effort at every input.
    #[must_use]
    pub fn sought(&self) -> Vec<Sought> {
        let named = self.named_sought();
        if named.is_empty() { (0..self.inputs.len()).map(Sought::Effort).collect() } else { named }
    }

    /// What the scene seeks by name.
    #[must_use]
    pub fn named_sought(&self) -> Vec<Sought> {
        let loads = self.forces.loads.iter().enumerate().filter(|(_, load)| load.is_sought());
        let springs = self.forces.springs.iter().enumerate().filter(|(_, spring)| spring.is_sought());
        let loads = loads.map(|(index, _)| Sought::Load(index));
        let spin = self.forces.spin.filter(|spin| spin.omega == SpinSpeed::Sought).map(|_| Sought::Spin);
        loads.chain(springs.map(|(index, _)| Sought::Spring(index))).chain(spin).collect()
    }

    /// What drives a pin that rides without a block, by index of the input, and the link that carries the guide. The drive
    /// stands between the two: it is no force of their pair.
    #[must_use]
    pub fn drive_of_pin(&self, pin: PointId) -> Option<(usize, LinkId)> {
        self.inputs.iter().enumerate().find_map(|(index, input)| {
            let Input::Slide { slide, .. } = input else { return None };
            let slide = self.slides.get(*slide)?;
            (self.party_of(&slide.rider) == Party::Pin(pin)).then_some((index, slide.guide.link))
        })
    }

    /// The same of the pin at which two links alone meet, one of which carries its guide.
    #[must_use]
    pub fn drive_between(&self, pin: PointId, links: [LinkId; 2]) -> Option<(usize, LinkId)> {
        let (input, guide) = self.drive_of_pin(pin)?;
        (links.contains(&guide) && self.parties_at(pin).len() == 2).then_some((input, guide))
    }

    /// In how many slots of a link a pin rides without a block.
    #[must_use]
    pub fn slots_at(&self, pin: PointId, link: LinkId) -> usize {
        let own = self.slides.iter().filter(|slide| self.party_of(&slide.rider) == Party::Pin(pin));
        own.filter(|slide| slide.guide.link == link).count()
    }

    /// The links between which a driven slide is driven: those that ride, and the one that carries the guide. None of
    /// another input.
    #[must_use]
    pub fn driven_between(&self, input: usize) -> Vec<LinkId> {
        let Some(Input::Slide { slide, .. }) = self.inputs.get(input) else { return Vec::new() };
        let pair = &self.slides[*slide];
        let mut links = match self.party_of(&pair.rider) {
            Party::Link(rider) => vec![rider],
            Party::Pin(pin) => self.parties_at(pin),
        };
        if !links.contains(&pair.guide.link) {
            links.push(pair.guide.link);
        }
        links
    }

    /// The link or the pin that rides in a sliding pair.
    #[must_use]
    pub fn party_of(&self, rider: &Rider) -> Party {
        match *rider {
            Rider::Link { link, .. } | Rider::Pin { block: Some(link), .. } => Party::Link(link),
            Rider::Pin { point, block: None } => Party::Pin(point),
        }
    }

    /// The links and sliding pairs that meet at a pin as bodies of their own: its links, and the carriers of bare slots
    /// in which it rides.
    #[must_use]
    pub fn parties_at(&self, pin: PointId) -> Vec<LinkId> {
        let mut links = self.point(pin).links.clone();
        for slide in &self.slides {
            if self.party_of(&slide.rider) == Party::Pin(pin) {
                links.push(slide.guide.link);
            }
        }
        links.sort_unstable();
        links.dedup();
        links
    }

    /// The link that holds a pin: the one that the scene names, the frame where it is one of the pin's links, or the
    /// only link in which the pin stands. None at a pin of several links about which nothing is said.
    #[must_use]
    pub fn carrier(&self, pin: PointId) -> Option<LinkId> {
        let links = &self.point(pin).links;
        let named = self.forces.carriers.iter().find(|(point, _)| *point == pin).map(|(_, link)| *link);
        named.or_else(|| links.contains(&LinkId::FRAME).then_some(LinkId::FRAME)).or(match links[..] {
            [only] => Some(only),
            _ => None,
        })
    }

    /// The pairs through which one link acts on another. At a pin that a third link holds two others have none where they
    /// have one elsewhere.
    #[must_use]
    pub fn pairs_between(&self, one: LinkId, other: LinkId) -> Vec<Through> {
        let mut pairs = Vec::new();
        let mut held = Vec::new();
        for pin in (0..self.points.len()).map(PointId) {
            let parties = self.parties_at(pin);
            if parties.contains(&one) && parties.contains(&other) && self.is_pin(pin) {
                let by_third = parties.len() > 2 && self.carrier(pin).is_some_and(|c| c != one && c != other);
                if by_third { held.push(Through::Pin(pin)) } else { pairs.push(Through::Pin(pin)) }
            }
        }
        for (index, slide) in self.slides.iter().enumerate() {
            if let Party::Link(rider) = self.party_of(&slide.rider)
                && [[one, other], [other, one]].contains(&[rider, slide.guide.link])
            {
                pairs.push(Through::Slide(index));
            }
        }
        for (index, roll) in self.rolls.iter().enumerate() {
            if [[one, other], [other, one]].contains(&roll.bodies()) {
                pairs.push(Through::Roll(index));
            }
        }
        if pairs.is_empty() { held } else { pairs }
    }

    /// The pin at which two links act on each other: that between them, or that of the block that slides.
    #[must_use]
    pub fn meeting_point(&self, one: LinkId, other: LinkId) -> Option<PointId> {
        self.pairs_between(one, other).into_iter().find_map(|pair| match pair {
            Through::Pin(pin) => Some(pin),
            Through::Slide(index) => match self.slides[index].rider {
                Rider::Pin { point, .. } => Some(point),
                Rider::Link { link, .. } => self.link(link).points.first().copied(),
            },
            Through::Roll(_) => None,
        })
    }

    /// Whether forces pass from one body to another at a point.
    #[must_use]
    pub fn is_pin(&self, point: PointId) -> bool {
        self.parties_at(point).len() > 1
    }

    /// The other body of a rolling pair, and this one.
    #[must_use]
    pub fn bodies_rolling(&self, roll: usize, on: LinkId) -> [LinkId; 2] {
        let [first, second] = self.rolls[roll].bodies();
        [if on == second { first } else { second }, on]
    }

    /// The force of a rolling pair on one of its bodies: that of the other one, where these have no pair besides.
    #[must_use]
    pub fn force_of_roll(&self, roll: usize, on: LinkId) -> Action {
        let [by, on] = self.bodies_rolling(roll, on);
        match self.pairs_between(by, on)[..] {
            [_] => Action::Pair { by, on },
            _ => Action::Rolling { roll, on },
        }
    }

    /// Why there is no equilibrium where a rolling pair that keeps its own contact would have to pull.
    #[must_use]
    pub fn say_pulls(&self, roll: usize) -> String {
        let [one, other] = self.rolls[roll].bodies().map(|link| self.link(link).number);
        format!("no equilibrium: links {one} and {other} roll on each other and would have to pull")
    }

    /// Why there is no motion where two bodies that roll on each other come apart, at this rate.
    #[must_use]
    pub fn say_parts(&self, roll: usize, rate: &str) -> String {
        let [one, other] = self.rolls[roll].bodies().map(|link| self.link(link).number);
        format!(
            "links {one} and {other} roll on each other and would come apart or press into each other, at {rate}: \
             nothing holds their centres"
        )
    }

    /// The point that an input drives along a guide: the pin that rides, or the first joint of the link that does.
    #[must_use]
    pub fn driven_point(&self, input: usize) -> Option<PointId> {
        let Input::Slide { slide, .. } = self.inputs.get(input)? else { return None };
        match self.slides[*slide].rider {
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => self.link(link).points.first().copied(),
        }
    }

    /// Why Zhukovsky's lever says nothing of the effort at an input, as a clause in plain English.
    #[must_use]
    pub fn lever_refused(&self, input: usize) -> Option<&'static str> {
        let slides = |slide: usize| self.slides[slide].guide.link != LinkId::FRAME;
        if !self.forces.friction.is_empty() {
            return Some("the lever has no friction: what rubs does work that hangs on how hard it presses");
        }
        if self.forces.spin.is_some() {
            return Some("the lever is of a motion in the plane, and the plane of a governor turns");
        }
        if self.inputs.len() > 1 {
            return Some("the lever is one equation, and more than one input has an effort");
        }
        if !self.named_sought().is_empty() {
            return Some("the lever gives the effort at an input, and something else is sought");
        }
        match self.inputs.get(input) {
            None => Some("nothing drives the mechanism"),
            Some(Input::Slide { slide, .. }) if slides(*slide) => {
                Some("the lever gives the drive along a guide of the frame, and this guide moves")
            }
            Some(_) => None,
        }
    }

    /// The torsion springs whose torque hangs on how far they are wound up.
    pub fn springs_that_wind_up(&self) -> impl Iterator<Item = usize> + '_ {
        let winds = |spring: &Spring| {
            matches!((spring.kind, spring.law), (SpringKind::Torsion(_), SpringLaw::Stiffness { .. }))
        };
        let springs = self.forces.springs.iter().enumerate();
        springs.filter(move |(_, spring)| winds(spring)).map(|(index, _)| index)
    }

    /// Why a mechanism with this torsion spring has no closed cycle, as a clause in plain English.
    #[must_use]
    pub fn say_wound_up(&self, spring: usize) -> String {
        let name = &self.forces.springs[spring].name;
        format!("no closed cycle: the torsion spring {name} is wound up further with every turn of the input")
    }

    /// The links on which what is sought acts, the frame left out. None of an effort, whose input is balanced last.
    #[must_use]
    pub fn loaded_by(&self, sought: Sought) -> Vec<LinkId> {
        let mut links = match sought {
            Sought::Load(index) => vec![self.forces.loads[index].link],
            Sought::Spring(index) => match self.forces.springs[index].kind {
                SpringKind::Pull(ends) => ends.map(|(link, _)| link).to_vec(),
                SpringKind::Torsion(links) => links.to_vec(),
            },
            Sought::Spin => self.forces.masses.iter().map(|mass| mass.link).collect(),
            Sought::Effort(_) => Vec::new(),
        };
        links.retain(|link| *link != LinkId::FRAME);
        links
    }

    /// Whether all that what is sought acts on is driven by an angle: where it does no work, that link alone is left out of
    /// balance, and all others are balanced without it.
    #[must_use]
    pub fn is_sought_at_input(&self, sought: Sought) -> bool {
        let driven =
            |link: &LinkId| (0..self.inputs.len()).any(|input| self.driven_link(input) == Some(*link));
        self.loaded_by(sought).iter().all(driven)
    }

    /// Whether what is sought does no work wherever the mechanism stands: a torque on a link that never turns, a force on a
    /// point of the frame.
    #[must_use]
    pub fn is_always_idle(&self, sought: Sought) -> bool {
        let Sought::Load(index) = sought else { return false };
        let load = &self.forces.loads[index];
        match load.kind {
            LoadKind::Torque { .. } => self.never_turns(load.link),
            LoadKind::Force { at, .. } | LoadKind::Vector { at, .. } => {
                self.point(at).links.contains(&LinkId::FRAME)
            }
        }
    }

    /// Whether a link is the frame, slides without turning against a link that never turns, or is a block on its straight guide.
    fn never_turns(&self, link: LinkId) -> bool {
        let translating = self.translating();
        let block = |slide: &super::Slide| {
            matches!(slide.rider, Rider::Pin { block: Some(block), .. } if block == link)
                && matches!(slide.guide.path, super::Path::Straight { .. })
        };
        let mut guides = self.slides.iter().filter(|slide| block(slide));
        translating[link.0] || guides.any(|slide| translating[slide.guide.link.0])
    }

    /// The link that an input drives by its angle.
    #[must_use]
    pub fn driven_link(&self, input: usize) -> Option<LinkId> {
        match self.inputs.get(input)? {
            Input::Angle { link, .. } | Input::Speed { link, .. } => Some(*link),
            Input::Slide { .. } => None,
        }
    }
}

/// What rides in a sliding pair.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Party {
    /// A link or a block.
    Link(LinkId),
    /// A pin in a bare slot.
    Pin(PointId),
}

/// A pair through which two links act on each other.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Through {
    /// At a pin.
    Pin(PointId),
    /// In a sliding pair, by index.
    Slide(usize),
    /// At a rolling contact, by index.
    Roll(usize),
}

/// A force with a line of action, as a scene may ask for it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Action {
    /// `F(2,3)`: of the first link on the second through their pair.
    Pair {
        /// The link that acts.
        by: LinkId,
        /// The link on which it acts.
        on: LinkId,
    },
    /// `F(B,4)`: of a pin on a link.
    OfPin(PointId, LinkId),
    /// `F(4,B)`: of a link on a pin.
    OnPin(LinkId, PointId),
    /// `Fin(3)`: −M A_G of a link, with its couple.
    Inertia(LinkId),
    /// `Fc(3)`: M ω² r of a link in the plane of a governor.
    Centrifugal(LinkId),
    /// `FS`: the sum of all inertia forces.
    Shaking,
    /// `F(frame)`: all that moving links exert on the frame through pairs.
    OnFrame,
    /// `load(P)`: a load that is a force, by its index.
    Load(usize),
    /// The weight of a link; drawn, not asked.
    Weight(LinkId),
    /// The pull of a spring on one of its two ends; drawn, not asked.
    Spring {
        /// Index of the spring.
        index: usize,
        /// 0 or 1.
        end: usize,
    },
    /// The force along the guide on a driven slide, by index of the input; drawn, not asked.
    Drive(usize),
    /// The same on the link that carries the guide, the other way round; drawn, not asked.
    DriveBack(usize),
    /// What drags on the sleeve of a governor, by index of its sliding pair; drawn, not asked.
    Drag(usize),
    /// The force of a rolling pair on one of its bodies, where these meet in another pair besides; drawn, not asked.
    Rolling {
        /// Index of the rolling pair.
        roll: usize,
        /// The body on which it acts.
        on: LinkId,
    },
}

/// A quantity of the forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Force {
    /// A force. Vector.
    Vector(Action),
    /// `Fn(3,4/O4)`: the part of F(3,4) along the line from a point to their pin. Vector.
    Along {
        /// The link that acts.
        by: LinkId,
        /// The link on which it acts.
        on: LinkId,
        /// The point.
        from: PointId,
    },
    /// `Ft(3,4/O4)`: the part of F(3,4) across that line. Vector.
    Across {
        /// The link that acts.
        by: LinkId,
        /// The link on which it acts.
        on: LinkId,
        /// The point.
        from: PointId,
    },
    /// `T(2)`: the torque of the surroundings at an input that drives a link, by index of the input. Signed scalar.
    Torque(usize),
    /// `drive(D)`: the force along the guide at a driven slide, by index of the input. Signed scalar.
    Drive(usize),
    /// `load(P)`: a load that is a torque, by its index. Signed scalar.
    LoadTorque(usize),
    /// `spring(S)`: the pull of a spring, by its index. Signed scalar.
    Pull(usize),
    /// `spring(S)`: the torque of a torsion spring on its second link, by its index. Signed scalar.
    Twist(usize),
    /// `spin`, `spin(rising)`, `spin(falling)`: the speed at which a governor is in equilibrium. Scalar, not negative.
    Spin,
    /// `Tin(3)`: −I_G ε of a link. Signed scalar.
    InertiaTorque(LinkId),
    /// `h(3)`: |Tin| / |Fin|. Scalar, not negative, or at infinity.
    Offset(LinkId),
    /// `moment(X,P)`: of a force about a point, with its couple. Signed scalar.
    Moment(Action, PointId),
    /// `arm(X,P)`: distance of its line from a point. Scalar, not negative.
    Arm(Action, PointId),
}

/// Something that acts, of which the scene says no direction of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Unaimed {
    /// A load, by its index.
    Load(usize),
    /// A spring, by its index.
    Spring(usize),
}

impl Mechanism {
    /// Why what is sought is not determined where it does no work, as a clause in plain English.
    #[must_use]
    pub fn say_idle(&self, sought: Sought) -> String {
        match sought {
            Sought::Load(index) => {
                let load = &self.forces.loads[index];
                let why = if load.is_torque() {
                    "its link does not turn with the input"
                } else {
                    "its line has no arm about the pole of its link"
                };
                format!("the sought load {} does no work here: {why}", load.name)
            }
            Sought::Spring(index) => {
                let name = &self.forces.springs[index].name;
                format!(
                    "the sought spring {name} does no work here: no motion changes its length or its angle"
                )
            }
            Sought::Spin => {
                "no centrifugal force does work here: no mass off the axis moves to or from it".to_owned()
            }
            Sought::Effort(_) => "the sought effort does no work here".to_owned(),
        }
    }

    /// Why something that acts has no direction here, as a clause in plain English.
    #[must_use]
    pub fn say_unaimed(&self, what: Unaimed) -> String {
        let name = |point: PointId| self.point(point).name.as_str();
        match what {
            Unaimed::Load(index) => {
                let load = &self.forces.loads[index];
                let why = match load.kind {
                    LoadKind::Force { at, pointing: Pointing::Motion { .. }, .. } => {
                        format!("no direction: the loaded point {} does not move", name(at))
                    }
                    LoadKind::Force { pointing: Pointing::Between { from, to, .. }, .. } => {
                        format!("no direction: {} and {} are one place", name(from), name(to))
                    }
                    _ => format!("no sense: the loaded link {} does not turn", self.link(load.link).number),
                };
                format!("loads[{index}] has {why}")
            }
            Unaimed::Spring(index) => {
                let ends = match self.forces.springs[index].kind {
                    SpringKind::Pull(ends) => ends.map(|(_, point)| name(point)).join(" and "),
                    SpringKind::Torsion(_) => "its ends".to_owned(),
                };
                format!("springs[{index}] has no direction: {ends} are one place")
            }
        }
    }
}

/// Which part of a force.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Share {
    /// All of it.
    #[default]
    Total,
    /// From loads, weights and springs alone.
    Static,
    /// From inertia alone.
    Inertia,
    /// From everything, while the sleeve of a governor is about to move along its guide.
    Rising,
    /// The same, while it is about to move back.
    Falling,
}

impl Share {
    /// What stands after a name in a scene.
    #[must_use]
    pub fn suffix(self) -> &'static str {
        match self {
            Self::Total => "",
            Self::Static => ".static",
            Self::Inertia => ".inertia",
            Self::Rising => "(rising)",
            Self::Falling => "(falling)",
        }
    }
}

impl Action {
    /// As a scene names it.
    #[must_use]
    pub fn name(self, mechanism: &Mechanism) -> String {
        let p = |point: PointId| mechanism.point(point).name.as_str();
        let l = |link: LinkId| mechanism.link(link).number;
        match self {
            Self::Pair { by, on } => format!("F({},{})", l(by), l(on)),
            Self::OfPin(pin, link) => format!("F({},{})", p(pin), l(link)),
            Self::OnPin(link, pin) => format!("F({},{})", l(link), p(pin)),
            Self::Inertia(link) => format!("Fin({})", l(link)),
            Self::Centrifugal(link) => format!("Fc({})", l(link)),
            Self::Shaking => "FS".to_owned(),
            Self::OnFrame => "F(frame)".to_owned(),
            Self::Load(index) => format!("load({})", mechanism.forces.loads[index].name),
            Self::Weight(link) => format!("W({})", l(link)),
            Self::Spring { index, .. } => format!("spring({})", mechanism.forces.springs[index].name),
            Self::Drive(input) => Force::Drive(input).name(mechanism),
            Self::DriveBack(input) => format!("-{}", Force::Drive(input).name(mechanism)),
            Self::Drag(slide) => match mechanism.slides[slide].rider {
                Rider::Pin { point, .. } => format!("drag({})", p(point)),
                Rider::Link { link, .. } => format!("drag({})", l(link)),
            },
            Self::Rolling { roll, on } => {
                let [by, on] = mechanism.bodies_rolling(roll, on);
                format!("F({},{})", l(by), l(on))
            }
        }
    }

    /// The points and links that it names.
    #[must_use]
    pub fn about(self) -> ([Option<PointId>; 2], [Option<LinkId>; 2]) {
        match self {
            Self::Pair { by, on } => ([None; 2], [Some(by), Some(on)]),
            Self::OfPin(pin, link) | Self::OnPin(link, pin) => ([Some(pin), None], [Some(link), None]),
            Self::Inertia(link)
            | Self::Centrifugal(link)
            | Self::Weight(link)
            | Self::Rolling { on: link, .. } => ([None; 2], [Some(link), None]),
            Self::Shaking
            | Self::OnFrame
            | Self::Load(_)
            | Self::Spring { .. }
            | Self::Drive(_)
            | Self::DriveBack(_)
            | Self::Drag(_) => ([None; 2], [None; 2]),
        }
    }
}

impl Force {
    /// What it measures.
    #[must_use]
    pub const fn measure(self) -> Measure {
        match self {
            Self::Vector(_) | Self::Along { .. } | Self::Across { .. } | Self::Drive(_) | Self::Pull(_) => {
                Measure::Force
            }
            Self::Torque(_)
            | Self::LoadTorque(_)
            | Self::Twist(_)
            | Self::InertiaTorque(_)
            | Self::Moment(..) => Measure::Torque,
            Self::Offset(_) | Self::Arm(..) => Measure::Length,
            Self::Spin => Measure::AngularVelocity,
        }
    }

    /// As a scene names it.
    #[must_use]
    pub fn name(self, mechanism: &Mechanism) -> String {
        let p = |point: PointId| mechanism.point(point).name.as_str();
        let l = |link: LinkId| mechanism.link(link).number;
        match self {
            Self::Vector(action) => action.name(mechanism),
            Self::Along { by, on, from } => format!("Fn({},{}/{})", l(by), l(on), p(from)),
            Self::Across { by, on, from } => format!("Ft({},{}/{})", l(by), l(on), p(from)),
            Self::Torque(input) => {
                let link = mechanism.driven_link(input).map_or(0, l);
                format!("T({link})")
            }
            Self::Drive(input) => match mechanism.inputs.get(input) {
                Some(Input::Slide { slide, .. }) => match mechanism.slides[*slide].rider {
                    Rider::Pin { point, .. } => format!("drive({})", p(point)),
                    Rider::Link { link, .. } => format!("drive({})", l(link)),
                },
                _ => "drive".to_owned(),
            },
            Self::LoadTorque(index) => format!("load({})", mechanism.forces.loads[index].name),
            Self::Pull(index) | Self::Twist(index) => {
                format!("spring({})", mechanism.forces.springs[index].name)
            }
            Self::Spin => "spin".to_owned(),
            Self::InertiaTorque(link) => format!("Tin({})", l(link)),
            Self::Offset(link) => format!("h({})", l(link)),
            Self::Moment(action, about) => format!("moment({},{})", action.name(mechanism), p(about)),
            Self::Arm(action, about) => format!("arm({},{})", action.name(mechanism), p(about)),
        }
    }

    /// The points and links that it names.
    #[must_use]
    pub fn about(self) -> ([Option<PointId>; 2], [Option<LinkId>; 2]) {
        match self {
            Self::Vector(action) => action.about(),
            Self::Along { by, on, from } | Self::Across { by, on, from } => {
                ([Some(from), None], [Some(by), Some(on)])
            }
            Self::InertiaTorque(link) | Self::Offset(link) => ([None; 2], [Some(link), None]),
            Self::Moment(action, about) | Self::Arm(action, about) => {
                let ([pin, _], links) = action.about();
                ([pin, Some(about)], links)
            }
            Self::Torque(_)
            | Self::Drive(_)
            | Self::LoadTorque(_)
            | Self::Pull(_)
            | Self::Twist(_)
            | Self::Spin => ([None; 2], [None; 2]),
        }
    }

    /// The two links of which it is the force of a pair, or a part of it.
    #[must_use]
    pub const fn pair(self) -> Option<[LinkId; 2]> {
        match self {
            Self::Vector(Action::Pair { by, on })
            | Self::Along { by, on, .. }
            | Self::Across { by, on, .. } => Some([by, on]),
            _ => None,
        }
    }

    /// Whether it is a vector.
    #[must_use]
    pub const fn is_vector(self) -> bool {
        matches!(self.nature(), Nature::Vector)
    }

    /// Whether its sign is a sense of rotation.
    #[must_use]
    pub const fn turns(self) -> bool {
        matches!(self.nature(), Nature::Rotation)
    }

    /// Of what nature its value is.
    #[must_use]
    pub const fn nature(self) -> Nature {
        match self {
            Self::Vector(_) | Self::Along { .. } | Self::Across { .. } => Nature::Vector,
            Self::Torque(_)
            | Self::LoadTorque(_)
            | Self::Twist(_)
            | Self::InertiaTorque(_)
            | Self::Moment(..) => Nature::Rotation,
            Self::Drive(_) | Self::Pull(_) => Nature::Signed,
            Self::Offset(_) | Self::Arm(..) | Self::Spin => Nature::Size,
        }
    }
}
