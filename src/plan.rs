//! From what is asked to the ordered steps that it needs, and no other.
//!
//! A scene that asks for velocities gets no acceleration step; a scene that asks for one link solves only
//! the groups on the way to it; a point that nobody asks for is not transferred.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;

use crate::mechanism::engine::Engine;
use crate::mechanism::force::{
    Action, Force, Heaviness, Inertia, LoadKind, Mass, Pointing, Share, Sought, SpringKind,
};
use crate::mechanism::friction::RubbingPair;
use crate::mechanism::quantity::{Asked, DiagramKind, Method, Order, Quantity};
use crate::mechanism::structure::{Closing, GroupKind, Hold, Joint, Structure, Trial, TrialDriver, Unknown};
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Rider, Roll, Slide};

/// From what instant centres are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CentreSource {
    /// From the circle diagram alone: positions suffice.
    Diagram,
    /// Where the diagram stalls, from the velocity polygon as well.
    Velocities,
}

/// A construction on the skeleton besides the polygons and the circle diagram.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Auxiliary {
    /// Klein's construction on a slider-crank.
    Klein {
        /// The slider-crank.
        crank: Engine,
        /// Velocities only, or accelerations as well.
        order: Order,
    },
    /// The inflection circle and the acceleration centre of a link.
    Inflection {
        /// The link.
        link: LinkId,
    },
    /// Kennedy's theorem on three links; the first is common to the two centres that are taken as known.
    Kennedy {
        /// The links.
        links: [LinkId; 3],
    },
    /// The centre of the rotation of a link from the present position to another.
    Rotation {
        /// The link.
        link: LinkId,
        /// Where the one input stands then: radians, or metres of a slide.
        to: f64,
    },
    /// The inertia of a link as that of two masses.
    TwoMasses {
        /// The link.
        link: LinkId,
        /// Where the first mass stands.
        first: PointId,
        /// Where the second one stands, if that is a point of the link.
        second: Option<PointId>,
    },
    /// Zhukovsky's lever: the velocity polygon turned by a quarter, with every force on the image of its point.
    Lever {
        /// The input whose effort it gives.
        input: usize,
    },
    /// The loci of an instant centre in both its links.
    Centrodes {
        /// The links: in the first the locus is called fixed.
        links: [LinkId; 2],
    },
}

impl Auxiliary {
    /// The name of its figure.
    #[must_use]
    pub const fn figure(&self) -> &'static str {
        match self {
            Self::Klein { .. } => "klein",
            Self::Inflection { .. } => "inflection",
            Self::Kennedy { .. } => "kennedy",
            Self::Rotation { .. } => "rotation-centre",
            Self::TwoMasses { .. } => "equivalent",
            Self::Lever { .. } => "lever",
            Self::Centrodes { .. } => "centrodes",
        }
    }

    /// The instant centres that it needs.
    #[must_use]
    pub fn centres(&self) -> Vec<[LinkId; 2]> {
        match *self {
            Self::Kennedy { links: [i, j, k] } => vec![chord(i, j), chord(i, k), chord(j, k)],
            Self::Centrodes { links: [i, j] } => vec![chord(i, j)],
            Self::Klein { .. }
            | Self::Inflection { .. }
            | Self::Rotation { .. }
            | Self::TwoMasses { .. }
            | Self::Lever { .. } => Vec::new(),
        }
    }
}

/// How much of the skeleton is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Only what the asked quantities need: for numbers.
    Asked,
    /// Every link and point, so that the skeleton can be shown: for figures.
    WholeSkeleton,
    /// The same with all instant centres, where the scene asks for none: for figures of the circle diagram.
    AllCentres,
}

/// The steps of a group of higher class: every group of the trial with the points that are wanted of it, that
/// later groups need, and that close the trial.
#[must_use]
pub fn trial_steps(trial: &Trial, step: &GroupStep, mechanism: &Mechanism) -> Vec<GroupStep> {
    let mut wanted: BTreeSet<PointId> = step.points.iter().map(|(_, p)| *p).collect();
    for (driver, closing) in &trial.drivers {
        match *closing {
            Closing::Rod { near, far, .. } => wanted.extend([near, far]),
            Closing::Slide { slide, pin } | Closing::Driven { slide, pin, .. } => {
                wanted.insert(pin);
                wanted.extend(mechanism.link(mechanism.slides[slide].guide.link).points.first());
            }
            Closing::Angle { link, .. } => wanted.extend(mechanism.link(link).points.iter().take(2)),
            Closing::Roll { roll } | Closing::Contact { roll, .. } => match mechanism.rolls[roll] {
                Roll::Circles { centres, .. } => wanted.extend(centres),
                Roll::Line { guide, centre, .. } => {
                    wanted.insert(centre);
                    wanted.extend(mechanism.link(guide.link).points.first());
                }
            },
        }
        if let TrialDriver::Turn(link) = *driver {
            wanted.extend(mechanism.link(link).points.iter().take(2));
        }
    }
    for group in &trial.groups {
        wanted.extend(group.kind.bases());
        wanted.extend(&group.points);
    }
    let mut found: BTreeSet<PointId> = BTreeSet::new();
    let mut steps = Vec::new();
    for (index, group) in trial.groups.iter().enumerate() {
        let main = group.kind.main_points(mechanism);
        let mut points = Vec::new();
        for &link in group.links.iter().filter(|&&l| !mechanism.link(l).block) {
            for &point in &mechanism.link(link).points {
                let fresh = wanted.contains(&point) && !found.contains(&point);
                if fresh && !mechanism.is_fixed(point) && !main.contains(&point) {
                    found.insert(point);
                    points.push((link, point));
                }
            }
        }
        found.extend(main);
        steps.push(GroupStep { group: index, points });
    }
    steps
}

/// One group at one order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupStep {
    /// Index into [`Structure::groups`].
    pub group: usize,
    /// Points to be found besides those by which the group is solved, each on the link that carries it.
    pub points: Vec<(LinkId, PointId)>,
}

/// The steps that the asked quantities need, in order of transmission.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Plan {
    /// The diagrams that are drawn group by group, in order; those without a step are left out.
    pub diagrams: Vec<DiagramPlan>,
    /// The circle diagram.
    pub centres: CentrePlan,
    /// The constructions on the skeleton.
    pub auxiliary: Vec<Auxiliary>,
    /// The balance of forces.
    pub forces: ForcePlan,
    /// The contact points of rolling pairs whose accelerations are asked for: there the polygon has the normal parts too.
    pub at_contacts: BTreeSet<PointId>,
}

/// Of what the balance of forces is drawn.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct ForcePlan {
    /// The groups whose balance is needed, in order of transmission; it is drawn from the last to the first.
    pub groups: BTreeSet<usize>,
    /// Their links.
    pub links: BTreeSet<LinkId>,
    /// Which parts of the forces are asked.
    pub shares: Vec<Share>,
}

/// The steps of one diagram.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct DiagramPlan {
    /// Which.
    pub kind: DiagramKind,
    /// Its steps, in order of transmission.
    pub steps: Vec<GroupStep>,
}

/// What the circle diagram must lead to, and with which links.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CentrePlan {
    /// The links between which centres may be used: those that are solved on the way to the wanted ones. Empty
    /// where no centre is wanted.
    pub links: BTreeSet<LinkId>,
    /// The wanted centres, by their links, the lower first.
    pub wanted: BTreeSet<[LinkId; 2]>,
    /// Primary centres that may not be used.
    pub barred: BTreeSet<[LinkId; 2]>,
    /// Where the diagram stalls, centres are taken from the velocity polygon, which is then planned as well.
    pub with_velocities: bool,
    /// The velocity diagram is laid off from centres, to feed an acceleration polygon.
    pub feeds: bool,
    /// What is sought first, as if it were alone: the ways to centres that are asked for do not hang on what is shown besides.
    pub first: Option<Box<Self>>,
}

/// The contact points of which an acceleration is asked for.
fn at_contacts(mechanism: &Mechanism) -> BTreeSet<PointId> {
    let asked = mechanism.asked.iter().map(|asked| asked.quantity);
    let about = asked.filter(|of| of.order() == Order::Acceleration).flat_map(|of| of.about().0);
    about.flatten().filter(|point| mechanism.roll_at(*point).is_some()).collect()
}

/// The links of a centre, the lower first.
#[must_use]
pub fn chord(i: LinkId, j: LinkId) -> [LinkId; 2] {
    if i <= j { [i, j] } else { [j, i] }
}

impl Plan {
    /// Plans for the asked quantities of a mechanism.
    #[must_use]
    pub fn new(mechanism: &Mechanism, structure: &Structure, extent: Extent) -> Self {
        Self::with(mechanism, structure, extent, CentreSource::Diagram)
    }

    /// Plans again where the circle diagram stalls; see [`CentreSource`].
    #[must_use]
    pub fn with(mechanism: &Mechanism, structure: &Structure, extent: Extent, source: CentreSource) -> Self {
        Self::with_auxiliary(mechanism, structure, extent, source, &[])
    }

    /// The same with constructions on the skeleton, besides those by which a quantity is asked.
    #[must_use]
    pub fn with_auxiliary(
        mechanism: &Mechanism,
        structure: &Structure,
        extent: Extent,
        source: CentreSource,
        auxiliary: &[Auxiliary],
    ) -> Self {
        Self::leaving_out(mechanism, structure, extent, source, auxiliary, &BTreeSet::new())
    }

    /// The same without what depends on these groups, by index, unless it is asked for.
    #[must_use]
    pub fn leaving_out(
        mechanism: &Mechanism,
        structure: &Structure,
        extent: Extent,
        source: CentreSource,
        auxiliary: &[Auxiliary],
        left_out: &BTreeSet<usize>,
    ) -> Self {
        let fresh = || Wanted {
            mechanism,
            structure,
            source,
            steps: BTreeMap::new(),
            auxiliary: Vec::new(),
            forces: ForcePlan::default(),
        };
        // Whether something can be had without those groups.
        let open = |want: &dyn Fn(&mut Wanted<'_>)| {
            if left_out.is_empty() {
                return true;
            }
            let mut way = fresh();
            want(&mut way);
            way.steps.keys().all(|(_, group)| !left_out.contains(group))
        };
        let mut wanted = fresh();
        for asked in mechanism.asked.iter().filter(|a| !a.by_centres()) {
            match (asked.method, asked.quantity) {
                (Method::Klein, _) => wanted.klein(&asked.quantity),
                (
                    Method::TwoMasses { first, second },
                    Quantity::Force(Force::Vector(Action::Inertia(link)), _),
                ) => wanted.auxiliary(Auxiliary::TwoMasses { link, first, second }),
                (Method::Lever, Quantity::Force(Force::Torque(input) | Force::Drive(input), _)) => {
                    wanted.auxiliary(Auxiliary::Lever { input });
                }
                _ => wanted.quantity(&asked.quantity),
            }
        }
        for &auxiliary in auxiliary {
            wanted.auxiliary(auxiliary);
        }
        let centres =
            wanted.centres(extent, &|links| open(&|way: &mut Wanted<'_>| way.centre(links[0], links[1])));
        if extent != Extent::Asked {
            for point in (0..mechanism.points.len()).map(PointId) {
                if open(&|way| way.point(point, Order::Position)) {
                    wanted.point(point, Order::Position);
                }
            }
            for link in mechanism.moving() {
                if open(&|way| way.link(link, Order::Position)) {
                    wanted.link(link, Order::Position);
                }
            }
        }
        let steps_of = |order: Order| {
            wanted
                .steps
                .iter()
                .filter(|((o, _), _)| *o == order)
                .map(|((_, group), points)| GroupStep {
                    group: *group,
                    points: points.iter().copied().collect(),
                })
                .collect()
        };
        let diagram = |order: Order| DiagramPlan { kind: order.diagram(), steps: steps_of(order) };
        let all = [Order::Position, Order::Velocity, Order::Acceleration].map(diagram);
        Self {
            diagrams: all.into_iter().filter(|diagram| !diagram.steps.is_empty()).collect(),
            centres,
            auxiliary: wanted.auxiliary,
            forces: wanted.forces,
            at_contacts: at_contacts(mechanism),
        }
    }

    /// The steps of one order; none where nothing asked needs its diagram.
    #[must_use]
    pub fn steps(&self, order: Order) -> &[GroupStep] {
        let planned = self.diagrams.iter().find(|diagram| diagram.kind == order.diagram());
        planned.map_or(&[], |diagram| &diagram.steps)
    }

    /// The plan of the skeleton alone.
    #[must_use]
    pub fn skeleton(&self) -> Self {
        self.skeleton_of(|_| true)
    }

    /// The plan of the skeleton of some groups alone.
    #[must_use]
    pub fn skeleton_of(&self, kept: impl Fn(usize) -> bool) -> Self {
        let kind = DiagramKind::Skeleton;
        let steps = self.steps(Order::Position).iter().filter(|step| kept(step.group)).cloned().collect();
        Self { diagrams: vec![DiagramPlan { kind, steps }], ..Self::default() }
    }

    /// Which steps were kept and which left out, as text.
    #[must_use]
    pub fn explain<'a>(&'a self, mechanism: &'a Mechanism, structure: &'a Structure) -> Explanation<'a> {
        Explanation { plan: self, mechanism, structure }
    }
}

/// The link that the only input moves: the driven link, or what slides on a driven slide of the frame.
#[must_use]
pub fn driver(mechanism: &Mechanism) -> Option<LinkId> {
    let [input] = mechanism.inputs[..] else { return None };
    match input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => Some(link),
        Input::Slide { slide, .. } => {
            let slide = mechanism.slides[slide];
            let rider = match slide.rider {
                Rider::Link { link, .. } | Rider::Pin { block: Some(link), .. } => Some(link),
                Rider::Pin { block: None, point } => mechanism.point(point).links.first().copied(),
            };
            rider.filter(|_| slide.guide.link == LinkId::FRAME)
        }
    }
}

/// The link as whose point a velocity is found by its centre with the input: a slider on a fixed guide, whose pole
/// is seen from the pair, else the link whose group finds the point.
#[must_use]
pub fn transfer_home(mechanism: &Mechanism, structure: &Structure, point: PointId) -> Option<LinkId> {
    let slider = mechanism.slides.iter().find_map(|s| match s.rider {
        Rider::Pin { point: pin, block: Some(block) } if pin == point && s.guide.link == LinkId::FRAME => {
            Some(block)
        }
        _ => None,
    });
    slider.or_else(|| home(mechanism, structure, point))
}

/// The shortest chain of moving links from one to another, each with the pin by which it depends on the one before;
/// `None` where no moving pins join them.
#[must_use]
pub fn chain(mechanism: &Mechanism, from: LinkId, to: LinkId) -> Option<Vec<(LinkId, PointId)>> {
    let mut reached: Vec<(LinkId, Option<(usize, PointId)>)> = vec![(from, None)];
    let mut next = 0;
    while let Some(&(link, _)) = reached.get(next) {
        if link == to {
            let mut hops = Vec::new();
            let mut at = next;
            while let (on, Some((before, pin))) = reached[at] {
                hops.push((on, pin));
                at = before;
            }
            hops.reverse();
            return Some(hops);
        }
        let moving = mechanism.link(link).points.iter().filter(|&&p| !mechanism.is_fixed(p));
        for &pin in moving {
            for &other in &mechanism.point(pin).links {
                if other != LinkId::FRAME && reached.iter().all(|(l, _)| *l != other) {
                    reached.push((other, Some((next, pin))));
                }
            }
        }
        next += 1;
    }
    None
}

/// The link whose group finds a point first: `None` for a point of the frame or of no link.
#[must_use]
pub fn home(mechanism: &Mechanism, structure: &Structure, point: PointId) -> Option<LinkId> {
    if mechanism.is_fixed(point) {
        return None;
    }
    mechanism
        .point(point)
        .links
        .iter()
        .copied()
        .filter(|&l| structure.group_of(l).is_some())
        .min_by_key(|&l| (structure.group_of(l), mechanism.link(l).block, l))
}

struct Wanted<'a> {
    mechanism: &'a Mechanism,
    structure: &'a Structure,
    source: CentreSource,
    steps: BTreeMap<(Order, usize), BTreeSet<(LinkId, PointId)>>,
    auxiliary: Vec<Auxiliary>,
    forces: ForcePlan,
}

impl Wanted<'_> {
    /// The balance that leads to a force, and the motion that its loads hang on.
    fn force(&mut self, force: Force, share: Share) {
        let mechanism = self.mechanism;
        let moving = |links: Vec<LinkId>| -> Vec<LinkId> {
            links.into_iter().filter(|link| *link != LinkId::FRAME).collect()
        };
        let all = || mechanism.moving().collect::<Vec<_>>();
        let of_action = |action: Action| match action {
            Action::Pair { by, on } => {
                let mut links = vec![by, on];
                // At a pin of several links a force is what the others leave.
                for pin in (0..mechanism.points.len()).map(PointId) {
                    let parties = mechanism.parties_at(pin);
                    if parties.len() > 2 && parties.contains(&by) && parties.contains(&on) {
                        links.extend(parties);
                    }
                }
                moving(links)
            }
            Action::OfPin(pin, _) | Action::OnPin(_, pin) => moving(mechanism.parties_at(pin)),
            Action::Load(index) if mechanism.forces.loads[index].is_sought() => all(),
            Action::Centrifugal(_) if mechanism.named_sought().contains(&Sought::Spin) => all(),
            Action::Inertia(_) | Action::Centrifugal(_) | Action::Shaking | Action::Load(_) => Vec::new(),
            // Drawn beside what is asked.
            Action::Weight(_)
            | Action::Spring { .. }
            | Action::Drive(_)
            | Action::DriveBack(_)
            | Action::Drag(_)
            | Action::Rolling { .. } => Vec::new(),
            Action::OnFrame => all(),
        };
        let mut balanced = match force {
            Force::Vector(action) | Force::Moment(action, _) | Force::Arm(action, _) => of_action(action),
            Force::Along { by, on, .. } | Force::Across { by, on, .. } => of_action(Action::Pair { by, on }),
            Force::Torque(_) | Force::Drive(_) | Force::Spin => all(),
            Force::LoadTorque(index) if mechanism.forces.loads[index].is_sought() => all(),
            Force::Pull(index) | Force::Twist(index) if mechanism.forces.springs[index].is_sought() => all(),
            Force::LoadTorque(_)
            | Force::Pull(_)
            | Force::Twist(_)
            | Force::InertiaTorque(_)
            | Force::Offset(_) => Vec::new(),
        };
        // What is sought elsewhere than at an input is felt by everything.
        if !balanced.is_empty() && !mechanism.named_sought().is_empty() {
            balanced = all();
        }
        let mut groups: BTreeSet<usize> =
            balanced.iter().filter_map(|link| self.structure.group_of(*link)).collect();
        // A pin that rides in a bare slot may be found by a group without links.
        for (index, group) in self.structure.groups.iter().enumerate() {
            let drives = matches!(group.kind, GroupKind::DrivenSlide { .. });
            if group.after.iter().any(|before| groups.contains(before))
                || (drives && balanced.len() == mechanism.links.len() - 1)
            {
                groups.insert(index);
            }
        }
        let mut links: BTreeSet<LinkId> = BTreeSet::new();
        for &group in &groups {
            links.extend(self.structure.groups[group].links.iter().copied());
        }
        match force {
            Force::Vector(Action::Shaking)
            | Force::Moment(Action::Shaking, _)
            | Force::Arm(Action::Shaking, _) => {
                for mass in mechanism.forces.masses.clone() {
                    self.mass(&mass, share);
                    self.point(mass.centre, Order::Position);
                }
            }
            Force::Vector(Action::Inertia(link))
            | Force::Moment(Action::Inertia(link), _)
            | Force::Arm(Action::Inertia(link), _)
            | Force::Vector(Action::Centrifugal(link))
            | Force::Moment(Action::Centrifugal(link), _)
            | Force::Arm(Action::Centrifugal(link), _)
            | Force::InertiaTorque(link)
            | Force::Offset(link) => {
                if let Some(mass) = mechanism.forces.mass(link).copied() {
                    self.mass(&mass, share);
                    self.point(mass.centre, Order::Position);
                }
            }
            _ => {}
        }
        let (points, _) = force.about();
        for point in points.into_iter().flatten() {
            self.point(point, Order::Position);
        }
        if let Force::Vector(Action::Load(index))
        | Force::Moment(Action::Load(index), _)
        | Force::Arm(Action::Load(index), _)
        | Force::LoadTorque(index) = force
        {
            self.load(index);
        }
        if let Force::Pull(index) | Force::Twist(index) = force {
            self.spring(index);
        }
        for &link in &links {
            self.link(link, Order::Position);
            for point in mechanism.link(link).points.clone() {
                if mechanism.is_pin(point) {
                    self.point(point, Order::Position);
                }
            }
            if let Some(mass) = mechanism.forces.mass(link).copied() {
                self.point(mass.centre, Order::Position);
                self.mass(&mass, share);
            }
        }
        // What a guide and a link that rides on it exert on each other acts at the rider's first joint.
        for slide in &mechanism.slides {
            if let Rider::Link { link, .. } = slide.rider
                && (links.contains(&link) || links.contains(&slide.guide.link))
                && let Some(&point) = mechanism.link(link).points.first()
            {
                self.point(point, Order::Position);
            }
        }
        for &group in &groups {
            self.group(group, Order::Position);
        }
        for (index, load) in mechanism.forces.loads.iter().enumerate() {
            if links.contains(&load.link) {
                self.load(index);
            }
        }
        for (index, spring) in mechanism.forces.springs.iter().enumerate() {
            let between = match spring.kind {
                SpringKind::Pull(ends) => ends.map(|(link, _)| link),
                SpringKind::Torsion(between) => between,
            };
            if between.iter().any(|link| links.contains(link)) {
                self.spring(index);
            }
        }
        for pair in mechanism.rubbing_pairs() {
            self.rubbing(pair, &links);
        }
        // By how the sleeve would slide it is told in which senses all else moves once it is about to.
        if matches!(share, Share::Rising | Share::Falling)
            && !mechanism.forces.friction.is_empty()
            && let Some(sleeve) = mechanism.sleeve_slide()
            && let Some(point) = mechanism.pin_of_slide(sleeve)
        {
            self.point(point, Order::Velocity);
        }
        self.forces.groups.extend(groups);
        self.forces.links.extend(links);
        if !self.forces.shares.contains(&share) {
            self.forces.shares.push(share);
        }
    }

    /// The motion from which a pair that rubs has its sense.
    fn rubbing(&mut self, pair: RubbingPair, balanced: &BTreeSet<LinkId>) {
        let mechanism = self.mechanism;
        let links = mechanism.rubbing_links(pair);
        if !links.iter().any(|link| balanced.contains(link)) {
            return;
        }
        for link in links.into_iter().filter(|link| *link != LinkId::FRAME) {
            self.link(link, Order::Velocity);
        }
        if let RubbingPair::Slide(slide) = pair
            && let Some(point) = mechanism.pin_of_slide(slide)
        {
            self.point(point, Order::Velocity);
        }
    }

    /// The accelerations of a mass.
    fn mass(&mut self, mass: &Mass, share: Share) {
        if share == Share::Static || self.mechanism.rests_in_its_plane() {
            return;
        }
        if !self.mechanism.is_fixed(mass.centre) && mass.heaviness != Heaviness::None {
            self.point(mass.centre, Order::Acceleration);
        }
        if mass.inertia != Inertia::Point {
            self.link(mass.link, Order::Acceleration);
        }
    }

    fn load(&mut self, index: usize) {
        let load = &self.mechanism.forces.loads[index];
        let order = if load.follows_motion() { Order::Velocity } else { Order::Position };
        self.link(load.link, order);
        if let (Some(_), Some(driven)) = (load.curve(), self.mechanism.driven_link(0)) {
            self.link(driven, Order::Position);
        }
        if let Some(at) = load.at() {
            self.point(at, order);
        }
        if let LoadKind::Force { pointing, .. } = load.kind {
            match pointing {
                Pointing::Between { from, to, .. } => {
                    self.point(from, Order::Position);
                    self.point(to, Order::Position);
                }
                Pointing::Own { link, .. } => self.link(link, Order::Position),
                Pointing::World(_) | Pointing::Motion { .. } => {}
            }
        }
        if let LoadKind::Vector { of, .. } = load.kind {
            self.link(of, Order::Position);
        }
    }

    fn spring(&mut self, index: usize) {
        match self.mechanism.forces.springs[index].kind {
            SpringKind::Pull(ends) => {
                for (link, point) in ends {
                    self.link(link, Order::Position);
                    self.point(point, Order::Position);
                }
            }
            SpringKind::Torsion(links) => {
                for link in links.into_iter().filter(|link| *link != LinkId::FRAME) {
                    self.link(link, Order::Position);
                }
            }
        }
    }

    /// Klein's construction needs the skeleton and no polygon.
    fn klein(&mut self, quantity: &Quantity) {
        if let Some(crank) = Engine::with(self.mechanism, self.structure, quantity) {
            self.auxiliary(Auxiliary::Klein { crank, order: quantity.order() });
        }
    }

    fn auxiliary(&mut self, auxiliary: Auxiliary) {
        if self.auxiliary.contains(&auxiliary) {
            return;
        }
        match auxiliary {
            Auxiliary::Klein { crank, order } => {
                self.point(crank.crank_pin, Order::Position);
                self.link(crank.rod, Order::Position);
                let same = self.auxiliary.iter_mut().find_map(|known| match known {
                    Auxiliary::Klein { crank: c, order } if *c == crank => Some(order),
                    _ => None,
                });
                match same {
                    Some(known) => *known = order.max(*known),
                    None => self.auxiliary.push(auxiliary),
                }
            }
            Auxiliary::Inflection { link } => {
                self.link(link, Order::Acceleration);
                for point in self.mechanism.link(link).points.clone() {
                    self.point(point, Order::Acceleration);
                }
                self.auxiliary.push(auxiliary);
            }
            Auxiliary::Rotation { link, .. } => {
                for point in self.mechanism.link(link).points.clone() {
                    self.point(point, Order::Position);
                }
                self.auxiliary.push(auxiliary);
            }
            Auxiliary::TwoMasses { link, first, second } => {
                self.link(link, Order::Acceleration);
                let centre = self.mechanism.forces.mass(link).map(|mass| mass.centre);
                for point in [Some(first), second, centre].into_iter().flatten() {
                    self.point(point, Order::Acceleration);
                }
                self.auxiliary.push(auxiliary);
            }
            Auxiliary::Lever { input } => {
                self.lever(input);
                self.auxiliary.push(auxiliary);
            }
            // Their centres are planned with the circle diagram.
            Auxiliary::Kennedy { .. } | Auxiliary::Centrodes { .. } => self.auxiliary.push(auxiliary),
        }
    }

    /// What does work at the points and links of a mechanism, and how these move.
    fn lever(&mut self, input: usize) {
        let mechanism = self.mechanism;
        for (index, load) in mechanism.forces.loads.iter().enumerate() {
            self.load(index);
            match load.at() {
                Some(at) => self.point(at, Order::Velocity),
                None => self.link(load.link, Order::Velocity),
            }
        }
        for mass in &mechanism.forces.masses {
            self.mass(mass, Share::Total);
            self.point(mass.centre, Order::Velocity);
            if mass.inertia != Inertia::Point {
                self.link(mass.link, Order::Velocity);
            }
        }
        for (index, spring) in mechanism.forces.springs.iter().enumerate() {
            self.spring(index);
            match spring.kind {
                SpringKind::Pull(ends) => {
                    for (_, point) in ends {
                        self.point(point, Order::Velocity);
                    }
                }
                SpringKind::Torsion(links) => {
                    for link in links.into_iter().filter(|link| *link != LinkId::FRAME) {
                        self.link(link, Order::Velocity);
                    }
                }
            }
        }
        if let Some(link) = mechanism.driven_link(input) {
            self.link(link, Order::Velocity);
        }
        if let Some(pin) = mechanism.driven_point(input) {
            self.point(pin, Order::Velocity);
        }
    }

    fn quantity(&mut self, quantity: &Quantity) {
        let order = quantity.order();
        match *quantity {
            Quantity::Force(force, share) => self.force(force, share),
            // It is drawn from whole turns, not from this instant.
            Quantity::Cycle(_) => {}
            Quantity::Centre(i, j) => self.centre(i, j),
            // Of a pin that rubs only the turning of its links counts, and of a contact how one body moves.
            Quantity::Rub(_, i, j) => {
                self.link(i, order);
                self.link(j, order);
            }
            Quantity::ContactNormal(p, link, _) => {
                self.point(p, order);
                self.link(link, order);
            }
            _ => {
                let (points, links) = quantity.about();
                points.into_iter().flatten().for_each(|point| self.point(point, order));
                links.into_iter().flatten().for_each(|link| self.link(link, order));
            }
        }
        if let Quantity::Transmission(i, j) = *quantity {
            for p in transmission_points(self.mechanism, i, j).into_iter().flatten() {
                self.point(p, order);
            }
        }
    }

    /// Positions of the links on the way to both; velocities only where the circle diagram has stalled.
    fn centre(&mut self, i: LinkId, j: LinkId) {
        let order = match self.source {
            CentreSource::Diagram => Order::Position,
            CentreSource::Velocities => Order::Velocity,
        };
        for link in [i, j] {
            self.link(link, order);
            if self.source == CentreSource::Velocities {
                self.point_to_be_seen(link);
            }
        }
    }

    /// A centre that is read off velocities is seen from a point of the link: one of its own stands on the skeleton, if none
    /// of its joints is found with its group.
    fn point_to_be_seen(&mut self, link: LinkId) {
        let Some(group) = self.structure.group_of(link) else { return };
        let found = self.structure.groups[group].kind.main_points(self.mechanism);
        let points = &self.mechanism.link(link).points;
        if let (Some(&first), false) = (points.first(), points.iter().any(|point| found.contains(point))) {
            self.point(first, Order::Position);
        }
    }

    /// The centres by which a velocity is carried over from the input link, and the points that it leads to.
    fn transfer_centres(&mut self, asked: &Asked) -> BTreeSet<[LinkId; 2]> {
        let mut wanted = BTreeSet::new();
        let Some(input) = driver(self.mechanism) else { return wanted };
        let of = |point: PointId| match asked.method {
            Method::LinkToLink | Method::GaugeLine => home(self.mechanism, self.structure, point),
            _ => transfer_home(self.mechanism, self.structure, point),
        };
        let (links, points) = match asked.quantity {
            Quantity::Velocity(p) => (vec![of(p)], vec![p]),
            Quantity::RelativeVelocity(b, a) => (vec![of(b), of(a)], vec![a, b]),
            Quantity::CoincidentVelocity(p, l) => (vec![Some(l)], vec![p]),
            Quantity::Slip(p, l) => (vec![of(p), Some(l)], vec![p]),
            Quantity::Omega(l) => (vec![Some(l)], Vec::new()),
            Quantity::RelativeOmega(i, j)
            | Quantity::Ratio(i, j)
            | Quantity::Advantage(i, j)
            | Quantity::Rub(_, i, j) => (vec![Some(i), Some(j)], Vec::new()),
            _ => (Vec::new(), Vec::new()),
        };
        for point in points {
            self.point(point, Order::Position);
        }
        for link in links.into_iter().flatten().filter(|&l| l != LinkId::FRAME) {
            self.link(link, Order::Position);
            wanted.insert(chord(LinkId::FRAME, input));
            wanted.insert(chord(LinkId::FRAME, link));
            match asked.method {
                Method::LinkToLink | Method::GaugeLine => {
                    let hops = chain(self.mechanism, input, link).unwrap_or_default();
                    wanted.extend(hops.iter().map(|(on, _)| chord(LinkId::FRAME, *on)));
                    if let Some((on, _)) = hops.last() {
                        // ω is read between two points of the link.
                        for &point in self.mechanism.link(*on).points.iter().take(3) {
                            self.point(point, Order::Position);
                        }
                    }
                }
                _ if link != input => {
                    wanted.insert(chord(input, link));
                }
                _ => {}
            }
        }
        wanted
    }

    /// The wanted centres, with the links that their own steps solve.
    fn centres(&mut self, extent: Extent, open: &dyn Fn([LinkId; 2]) -> bool) -> CentrePlan {
        let asked = |a: &Asked| match a.quantity {
            Quantity::Centre(i, j) => Some(chord(i, j)),
            _ => None,
        };
        let mut wanted: BTreeSet<[LinkId; 2]> = self.mechanism.asked.iter().filter_map(asked).collect();
        for asked in self.mechanism.asked.iter().filter(|a| a.by_centres()) {
            wanted.extend(self.transfer_centres(asked));
        }
        let none_asked = wanted.is_empty();
        wanted.extend(self.auxiliary.iter().flat_map(Auxiliary::centres));
        if extent == Extent::AllCentres && none_asked {
            let all = 0..self.mechanism.links.len();
            wanted = all
                .clone()
                .flat_map(|i| all.clone().map(move |j| (i, j)))
                .filter(|(i, j)| i < j)
                .map(|(i, j)| [LinkId(i), LinkId(j)])
                .filter(|links| open(*links))
                .collect();
        }
        let feeds = self.mechanism.asked.iter().any(Asked::fed_by_centres);
        if feeds && let Some(input) = driver(self.mechanism) {
            let steps = self.steps.keys().filter(|(order, _)| *order == Order::Velocity);
            let groups: BTreeSet<usize> = steps.map(|(_, group)| *group).collect();
            let links = groups.iter().flat_map(|group| &self.structure.groups[*group].links);
            let links: BTreeSet<LinkId> = links.copied().collect();
            wanted.extend(links.iter().map(|link| chord(LinkId::FRAME, *link)));
            wanted.extend(links.iter().filter(|link| **link != input).map(|link| chord(input, *link)));
        }
        let mut way = Wanted {
            forces: ForcePlan::default(),
            mechanism: self.mechanism,
            structure: self.structure,
            source: self.source,
            steps: BTreeMap::new(),
            auxiliary: Vec::new(),
        };
        for &[i, j] in &wanted {
            self.centre(i, j);
            way.centre(i, j);
        }
        let mut links: BTreeSet<LinkId> = BTreeSet::new();
        if !wanted.is_empty() {
            links.insert(LinkId::FRAME);
            links.extend(
                way.steps.keys().flat_map(|(_, group)| self.structure.groups[*group].links.iter().copied()),
            );
        }
        // The pins of these links must stand on the skeleton.
        for point in (0..self.mechanism.points.len()).map(PointId) {
            let on = self.mechanism.point(point).links.iter().filter(|l| links.contains(l)).count();
            if on > 1 {
                self.point(point, Order::Position);
            }
        }
        CentrePlan {
            links,
            wanted,
            barred: BTreeSet::new(),
            with_velocities: self.source == CentreSource::Velocities,
            feeds,
            first: None,
        }
    }

    fn point(&mut self, point: PointId, order: Order) {
        let Some(group) = self.structure.group_finding(self.mechanism, point) else { return };
        self.group(group, order);
        if self.structure.groups[group].kind.main_points(self.mechanism).contains(&point) {
            return;
        }
        // A joint of the group that lies on none of its links is found by solving the group itself.
        let on_group = |link: LinkId| self.structure.group_of(link) == Some(group);
        let Some(link) = home(self.mechanism, self.structure, point).filter(|&l| on_group(l)) else { return };
        for lower in lower_orders(order) {
            if let Some(points) = self.steps.get_mut(&(*lower, group)) {
                points.insert((link, point));
            }
        }
    }

    /// Everything of solved links on which a group of higher class hangs.
    fn surroundings(&mut self, group: usize, order: Order) {
        let joints = self.structure.groups[group].joints.clone();
        for joint in joints {
            match joint {
                Joint::Pin(_, point) if !self.structure.groups[group].points.contains(&point) => {
                    self.point(point, order);
                }
                Joint::Slide(slide) => {
                    let slide = self.mechanism.slides[slide];
                    if let Rider::Pin { point, .. } = slide.rider
                        && !self.structure.groups[group].points.contains(&point)
                    {
                        self.point(point, order);
                    }
                    for link in [Some(slide.guide.link), slide_rider(&slide)].into_iter().flatten() {
                        if self.structure.group_of(link) != Some(group) {
                            self.link(link, order);
                        }
                    }
                }
                Joint::Roll(roll) => {
                    for body in self.mechanism.rolls[roll].bodies() {
                        if self.structure.group_of(body) != Some(group) {
                            self.link(body, order);
                        }
                    }
                    self.centres_of(roll, group, order);
                }
                Joint::Contact(roll) => {
                    if let Roll::Line { guide, .. } = self.mechanism.rolls[roll]
                        && self.structure.group_of(guide.link) != Some(group)
                    {
                        self.link(guide.link, order);
                    }
                    self.centres_of(roll, group, order);
                }
                _ => {}
            }
        }
    }

    /// The centres of a rolling pair that a group does not find itself.
    fn centres_of(&mut self, roll: usize, group: usize, order: Order) {
        let centres = match self.mechanism.rolls[roll] {
            Roll::Circles { centres, .. } => centres.to_vec(),
            Roll::Line { centre, .. } => vec![centre],
        };
        for centre in centres {
            if self.structure.group_finding(self.mechanism, centre) != Some(group) {
                self.point(centre, order);
            }
        }
    }

    /// The body on which a wheel rolls, and its centre where it has one.
    fn rolled_on(&mut self, roll: usize, wheel: LinkId, order: Order) {
        match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, .. } => {
                let other = usize::from(links[0] == wheel);
                self.link(links[other], order);
                self.point(centres[other], order);
            }
            Roll::Line { guide, wheel: own, centre, .. } => {
                self.link(if own == wheel { guide.link } else { own }, order);
                self.point(centre, order);
            }
        }
    }

    /// What holds the centre of a wheel by a contact: the other centre, or the body of the line; and the centre
    /// itself where it is solved.
    fn leans_on(&mut self, roll: usize, centre: PointId, order: Order) {
        match self.mechanism.rolls[roll] {
            Roll::Circles { centres, .. } => {
                for other in centres.into_iter().filter(|&other| other != centre) {
                    self.point(other, order);
                }
            }
            Roll::Line { guide, .. } => {
                self.link(guide.link, order);
                self.point(centre, order);
            }
        }
    }

    fn link(&mut self, link: LinkId, order: Order) {
        if let Some(group) = self.structure.group_of(link) {
            self.group(group, order);
        }
    }

    fn group(&mut self, group: usize, order: Order) {
        for &lower in lower_orders(order) {
            if self.steps.contains_key(&(lower, group)) {
                continue;
            }
            self.steps.insert((lower, group), BTreeSet::new());
            let kind = self.structure.groups[group].kind;
            for base in kind.bases() {
                self.point(base, lower);
            }
            if let GroupKind::Higher { .. } = kind {
                self.surroundings(group, lower);
            }
            if let GroupKind::Wheel { wheel, roll, .. } = kind {
                self.rolled_on(roll, wheel, lower);
            }
            if let GroupKind::Planet { wheel, rolls, .. } = kind {
                rolls.into_iter().for_each(|roll| self.rolled_on(roll, wheel, lower));
            }
            for unknown in kind.unknowns(self.mechanism).into_iter().flat_map(|(_, unknowns)| unknowns) {
                match unknown {
                    Unknown::Contact { roll, body } => self.rolled_on(roll, body, lower),
                    Unknown::Spin { roll, wheel, .. } => self.rolled_on(roll, wheel, lower),
                    Unknown::Roll { roll, centre, .. }
                    | Unknown::Carried { hold: Hold::Contact { roll, .. }, pin: centre, .. } => {
                        self.leans_on(roll, centre, lower);
                    }
                    Unknown::Turn { .. }
                    | Unknown::Reach { .. }
                    | Unknown::Slide { .. }
                    | Unknown::Carried { .. } => {}
                }
            }
            for slide in kind.slides(self.mechanism) {
                let slide = self.mechanism.slides[slide];
                for link in [Some(slide.guide.link), slide_rider(&slide)].into_iter().flatten() {
                    if self.structure.group_of(link) != Some(group) {
                        self.link(link, lower);
                    }
                }
            }
        }
    }
}

/// An order and what must be solved before it.
fn lower_orders(order: Order) -> &'static [Order] {
    match order {
        Order::Position => &[Order::Position],
        Order::Velocity => &[Order::Position, Order::Velocity],
        Order::Acceleration => &[Order::Position, Order::Velocity, Order::Acceleration],
    }
}

fn slide_rider(slide: &Slide) -> Option<LinkId> {
    match slide.rider {
        Rider::Link { link, .. } => Some(link),
        Rider::Pin { .. } => None,
    }
}

/// Pin and far ends of a transmission angle: the pin that coupler and output share, then the other end of
/// each (its fixed point, else its first other joint, else its first other point).
#[must_use]
pub fn transmission_points(mechanism: &Mechanism, coupler: LinkId, output: LinkId) -> [Option<PointId>; 3] {
    let shared =
        mechanism.link(coupler).points.iter().copied().find(|p| mechanism.point(*p).links.contains(&output));
    let Some(pin) = shared else { return [None; 3] };
    let end = |link: LinkId| {
        let others = || mechanism.link(link).points.iter().copied().filter(|&p| p != pin);
        others()
            .find(|&p| mechanism.is_fixed(p))
            .or_else(|| others().find(|&p| mechanism.point(p).links.len() > 1))
            .or_else(|| others().next())
    };
    [Some(pin), end(coupler), end(output)]
}

/// The text of [`Plan::explain`].
#[derive(Debug, Clone, Copy)]
pub struct Explanation<'a> {
    plan: &'a Plan,
    mechanism: &'a Mechanism,
    structure: &'a Structure,
}

impl fmt::Display for Explanation<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "mobility: {}", self.structure.mobility)?;
        let orders = [
            (Order::Position, "position"),
            (Order::Velocity, "velocity"),
            (Order::Acceleration, "acceleration"),
        ];
        for (order, name) in orders {
            for (index, group) in self.structure.groups.iter().enumerate() {
                let links: Vec<String> =
                    group.links.iter().map(|&l| self.mechanism.link(l).number.to_string()).collect();
                let step = self.plan.steps(order).iter().find(|s| s.group == index);
                let verdict = if step.is_some() { "kept   " } else { "skipped" };
                write!(f, "{verdict} {name}: {} of links {}", group.kind, links.join(", "))?;
                match step {
                    None => write!(f, " (nothing asked needs it)")?,
                    Some(step) if !step.points.is_empty() => {
                        let points: Vec<&str> =
                            step.points.iter().map(|(_, p)| self.mechanism.point(*p).name.as_str()).collect();
                        write!(f, " with {}", points.join(", "))?;
                    }
                    Some(_) => {}
                }
                writeln!(f)?;
            }
        }
        if self.plan.forces.groups.is_empty() {
            return Ok(());
        }
        // Forces are handed on from the output to the input.
        for (index, group) in self.structure.groups.iter().enumerate().rev() {
            let links: Vec<String> =
                group.links.iter().map(|&l| self.mechanism.link(l).number.to_string()).collect();
            let kept = self.plan.forces.groups.contains(&index);
            let verdict = if kept { "kept   " } else { "skipped" };
            write!(f, "{verdict} forces: {} of links {}", group.kind, links.join(", "))?;
            writeln!(f, "{}", if kept { "" } else { " (nothing asked needs it)" })?;
        }
        Ok(())
    }
}
