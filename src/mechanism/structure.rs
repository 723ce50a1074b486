//! Mobility by count, and decomposition into drivers and Assur groups in order of transmission.
//!
//! The count is Grübler's, F = 3(n − 1) − 2 p₁ − p₂ (a pin of k links is k − 1 pairs). The
//! decomposition plays the pebble game for bodies in the plane (Lee & Streinu, *Pebble game algorithms
//! and sparse graphs*, 2008): a link has three freedoms, a joint two, every constraint takes one; a
//! constraint that finds none free is redundant and is named. When the inputs have taken what is left,
//! "whose freedom pays for which constraint" orients the pairs, and the strongly connected parts of
//! that graph are the Assur groups, in the only order in which they can be solved.

use std::collections::BTreeSet;
use std::fmt;

pub use super::group::{GroupKind, Hold, Lead, Ram, Target, Unknown};
use super::{Guide, GuidePoint, Input, LinkId, Mechanism, Path, PointId, Rider, Roll, Slide};

/// A pair or an input, as a constraint between two links.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Joint {
    /// A link holds a joint.
    Pin(LinkId, PointId),
    /// Index into [`Mechanism::slides`].
    Slide(usize),
    /// Index into [`Mechanism::rolls`]; the no-slip condition.
    Roll(usize),
    /// Index into [`Mechanism::rolls`]; contact, where nothing else holds the distance.
    Contact(usize),
    /// Index into [`Mechanism::inputs`].
    Input(usize),
    /// What is assumed, to try a group that no construction solves at once.
    Trial(TrialDriver),
    /// It is known of a link how it turns: with another one, because links slide on each other without turning from the
    /// one to the other; or as it is driven or tried itself, where others turn with it.
    TurnsWith(LinkId, Drive),
}

/// What a trial moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum TrialDriver {
    /// A link is turned.
    Turn(LinkId),
    /// A rider is moved along its guide; index into [`Mechanism::slides`].
    Slide(usize),
}

/// What says how a driver moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Drive {
    /// Index into [`Mechanism::inputs`].
    Input(usize),
    /// It is assumed for a trial.
    Trial(TrialDriver),
    /// It turns with this link, which is solved, driven or tried.
    With(LinkId),
}

/// The count of mobility.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Mobility {
    /// n: links with the frame.
    pub links: usize,
    /// Turning pairs, with multiplicity.
    pub turning: usize,
    /// Sliding pairs (block or link on a guide).
    pub sliding: usize,
    /// Rolling pairs that also keep the bodies in contact: one freedom, so they count with the lower pairs.
    pub rolling: usize,
    /// Higher pairs of two freedoms (pin in a bare slot, gear mesh on held centres).
    pub higher: usize,
    /// F = 3(n − 1) − 2 p₁ − p₂.
    pub freedoms: i64,
    /// Number of inputs.
    pub inputs: usize,
}

impl fmt::Display for Mobility {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let lower = self.turning + self.sliding + self.rolling;
        write!(f, "n = {}, p1 = {lower} ({} turning, {} sliding", self.links, self.turning, self.sliding)?;
        if self.rolling > 0 {
            write!(f, ", {} rolling", self.rolling)?;
        }
        write!(
            f,
            "), p2 = {}: F = 3({} - 1) - 2*{lower} - {} = {}",
            self.higher, self.links, self.higher, self.freedoms
        )
    }
}

/// How a group of higher class is tried: with one thing driven and one constraint left open (or two and two) it
/// falls apart into groups that can be constructed; the trial that satisfies what is open is the solution. Where nothing is
/// driven it falls apart by itself, since it is known how some of its links turn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Trial {
    /// What is driven by trial, each until the constraint beside it is satisfied.
    pub drivers: Vec<(TrialDriver, Closing)>,
    /// The groups into which the rest falls, in order of transmission.
    pub groups: Vec<Group>,
}

/// A constraint that a trial leaves open.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Closing {
    /// A rod from a point of the group to another one, or to a pin on a solved link.
    Rod {
        /// The rod.
        link: LinkId,
        /// Its end in the group.
        near: PointId,
        /// Its other end.
        far: PointId,
    },
    /// A pin on a guide; or a link that slides without turning, whose turning is known without that: its first joint is to
    /// lie on the guide.
    Slide {
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// The pin, or the riding link's first joint.
        pin: PointId,
    },
    /// A link whose angle is given.
    Angle {
        /// The link.
        link: LinkId,
        /// Index into [`Mechanism::inputs`].
        input: usize,
    },
    /// A rider whose place along its guide is given.
    Driven {
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// The pin, or the riding link's first joint.
        pin: PointId,
        /// Index into [`Mechanism::inputs`].
        input: usize,
    },
    /// Two bodies that are held against each other.
    Contact {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
        /// A wheel.
        wheel: LinkId,
        /// Its centre.
        centre: PointId,
    },
    /// Two bodies that roll on each other without slip. It says nothing of the position, which is placed.
    Roll {
        /// Index into [`Mechanism::rolls`].
        roll: usize,
    },
}

/// A driver or an Assur group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Group {
    /// Its links, ascending, blocks among them.
    pub links: Vec<LinkId>,
    /// The joints that are found with it, ascending; not those that merely ride on one solved link.
    pub points: Vec<PointId>,
    /// Its pairs and inputs: those among its links and those to links of earlier groups.
    pub joints: Vec<Joint>,
    /// How it is solved.
    pub kind: GroupKind,
    /// The groups that must be solved before it, ascending indices.
    pub after: Vec<usize>,
}

/// A mechanism taken apart.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Structure {
    /// The count.
    pub mobility: Mobility,
    /// Drivers and groups in order of transmission.
    pub groups: Vec<Group>,
    /// The group of each link; `None` for the frame.
    pub group_of: Vec<Option<usize>>,
    /// How the groups of higher class are tried.
    pub trials: Vec<Trial>,
    /// The group of which each point is a joint, by point.
    joint_of: Vec<Option<usize>>,
}

/// Why a mechanism cannot be taken apart.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum StructureError {
    /// Freedoms are left over.
    #[error("{left} degree{} of freedom left over: {} not driven ({mobility})", plural(*left), list(links))]
    UnderConstrained {
        /// How many.
        left: usize,
        /// Numbers of the links that are still free to move.
        links: Vec<u32>,
        /// The count.
        mobility: Mobility,
    },
    /// A pair or input finds no freedom to take.
    #[error("{what} is one constraint too many ({mobility})")]
    OverConstrained {
        /// The pair or input, as the scene names it.
        what: String,
        /// The redundant joint.
        joint: Joint,
        /// The count.
        mobility: Mobility,
    },
}

fn plural(count: usize) -> &'static str {
    if count == 1 { "" } else { "s" }
}

fn list(links: &[u32]) -> String {
    let names: Vec<String> = links.iter().map(u32::to_string).collect();
    match names.as_slice() {
        [one] => format!("link {one}"),
        _ => format!("links {}", names.join(", ")),
    }
}

/// Freedoms of a link in the plane; also what any rigid part keeps against nothing.
const LINK_FREEDOMS: usize = 3;
/// Freedoms of a joint in the plane.
const POINT_FREEDOMS: usize = 2;

#[derive(Debug, Clone, Copy)]
struct Edge {
    ends: [usize; 2],
    joint: Joint,
    /// Which end's freedom pays for it.
    payer: usize,
}

impl Edge {
    fn other(&self, end: usize) -> usize {
        if self.ends[0] == end { self.ends[1] } else { self.ends[0] }
    }
}

/// The game's nodes: the links, then the joints.
struct Nodes {
    links: usize,
    points: Vec<PointId>,
    /// Where a point stands in their list, by point.
    index: Vec<Option<usize>>,
}

impl Nodes {
    fn of(mechanism: &Mechanism) -> Self {
        let mut rides = vec![false; mechanism.points.len()];
        for slide in &mechanism.slides {
            if let Rider::Pin { point, .. } = slide.rider {
                rides[point.0] = true;
            }
        }
        let points: Vec<PointId> = (0..mechanism.points.len())
            .map(PointId)
            .filter(|&id| mechanism.point(id).links.len() > 1 || rides[id.0])
            .collect();
        let mut index = vec![None; mechanism.points.len()];
        for (at, point) in points.iter().enumerate() {
            index[point.0] = Some(at);
        }
        Self { links: mechanism.links.len(), points, index }
    }

    fn count(&self) -> usize {
        self.links + self.points.len()
    }

    fn point(&self, id: PointId) -> Option<usize> {
        self.index.get(id.0).copied().flatten().map(|i| self.links + i)
    }

    fn freedoms(&self, node: usize) -> usize {
        if node < self.links { LINK_FREEDOMS } else { POINT_FREEDOMS }
    }
}

struct Game {
    freedoms: Vec<usize>,
    edges: Vec<Edge>,
    /// Indices of the edges that each node pays for.
    pays: Vec<Vec<usize>>,
    /// The search in which each node was last seen, and the edge by which it was come to.
    seen: Vec<(usize, Option<usize>)>,
    searches: usize,
}

/// The frame's node.
const FRAME: usize = 0;

impl Game {
    fn new(nodes: &Nodes) -> Self {
        Self {
            freedoms: (0..nodes.count()).map(|n| nodes.freedoms(n)).collect(),
            edges: Vec::new(),
            pays: vec![Vec::new(); nodes.count()],
            seen: vec![(0, None); nodes.count()],
            searches: 0,
        }
    }

    fn free(&self, node: usize) -> usize {
        self.freedoms[node] - self.pays[node].len()
    }

    /// Freedoms of the whole beyond those of a rigid body.
    fn left(&self) -> usize {
        (0..self.pays.len()).map(|n| self.free(n)).sum::<usize>() - LINK_FREEDOMS
    }

    /// Brings one free freedom to `root` by letting others pay, never taking one from `keep`.
    fn gather(&mut self, root: usize, keep: usize) -> bool {
        self.searches += 1;
        let now = self.searches;
        self.seen[root] = (now, None);
        self.seen[keep] = (now, None);
        let mut stack = vec![root];
        while let Some(node) = stack.pop() {
            if node != root && self.free(node) > 0 {
                let mut at = node;
                while let Some(edge) = self.seen[at].1 {
                    let from = self.edges[edge].payer;
                    self.pays[from].retain(|&e| e != edge);
                    self.pays[at].push(edge);
                    self.edges[edge].payer = at;
                    at = from;
                }
                return true;
            }
            for &edge in &self.pays[node] {
                let other = self.edges[edge].other(node);
                if self.seen[other].0 != now {
                    self.seen[other] = (now, Some(edge));
                    stack.push(other);
                }
            }
        }
        false
    }

    /// Takes one freedom between two nodes, if one is left.
    fn insert(&mut self, ends: [usize; 2], joint: Joint) -> bool {
        let [a, b] = ends;
        while self.free(a) < self.freedoms[a] && self.gather(a, b) {}
        while self.free(a) + self.free(b) <= LINK_FREEDOMS && self.gather(b, a) {}
        if a == b || self.free(a) + self.free(b) <= LINK_FREEDOMS {
            return false;
        }
        let payer = if self.free(b) > 0 { b } else { a };
        self.pays[payer].push(self.edges.len());
        self.edges.push(Edge { ends, joint, payer });
        true
    }

    /// Lets the frame pay for nothing.
    fn free_frame(&mut self) {
        while self.free(FRAME) < LINK_FREEDOMS && self.gather(FRAME, FRAME) {}
    }
}

impl Structure {
    /// Counts the freedoms and takes the mechanism apart.
    ///
    /// # Errors
    /// When constraints are redundant, or freedoms are left over after all inputs.
    pub fn of(mechanism: &Mechanism) -> Result<Self, StructureError> {
        let nodes = Nodes::of(mechanism);
        let mut game = Game::new(&nodes);
        let mut mobility = Mobility {
            links: nodes.links,
            turning: mechanism.pins.len(),
            sliding: 0,
            rolling: 0,
            higher: 0,
            freedoms: 0,
            inputs: mechanism.inputs.len(),
        };
        let mut redundant = None;
        for (joint, ends, count) in constraints(mechanism, &nodes) {
            match (joint, count) {
                (Joint::Slide(_), 2) => mobility.sliding += 1,
                (Joint::Slide(_) | Joint::Roll(_), _) => mobility.higher += 1,
                _ => {}
            }
            for _ in 0..count {
                if !game.insert(ends, joint) && redundant.is_none() {
                    redundant = Some(joint);
                }
            }
        }
        for (index, roll) in mechanism.rolls.iter().enumerate() {
            if game.left() > mechanism.inputs.len()
                && !holds_distance(mechanism, roll)
                && game.insert(contact_ends(&nodes, roll), Joint::Contact(index))
            {
                mobility.higher -= 1;
                mobility.rolling += 1;
            }
        }
        let lower = mobility.turning + mobility.sliding + mobility.rolling;
        let signed = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
        mobility.freedoms = 3 * (signed(nodes.links) - 1) - 2 * signed(lower) - signed(mobility.higher);
        for (index, input) in mechanism.inputs.iter().enumerate() {
            let ends = input_ends(mechanism, &nodes, input);
            if !game.insert(ends, Joint::Input(index)) && redundant.is_none() {
                redundant = Some(Joint::Input(index));
            }
        }
        if let Some(joint) = redundant {
            let what = name_of(mechanism, joint);
            return Err(StructureError::OverConstrained { what, joint, mobility });
        }
        if let Some((input, link)) = turned_twice(mechanism) {
            let joint = Joint::Input(input);
            let turns = match link {
                LinkId::FRAME => "which cannot turn".to_owned(),
                other => {
                    format!("which turns only with link {}, itself driven", mechanism.link(other).number)
                }
            };
            let what = format!("{}, {turns},", name_of(mechanism, joint));
            return Err(StructureError::OverConstrained { what, joint, mobility });
        }
        let left = game.left();
        if left > 0 {
            let links = undriven(mechanism, &mut game);
            return Err(StructureError::UnderConstrained { left, links, mobility });
        }
        game.free_frame();
        let mut structure = Self::assemble(mechanism, mobility, &nodes, &game);
        let held = structure.contacts();
        for index in 0..structure.groups.len() {
            let group = &structure.groups[index];
            if group.kind != GroupKind::Other {
                continue;
            }
            let way = Trial::ways(mechanism, &held, group).next();
            let way = way.or_else(|| Trial::further_ways(mechanism, &held, group).next());
            let way = way.or_else(|| Trial::ways_by_rides(mechanism, &held, group).next());
            if let Some(trial) = way {
                structure.groups[index].kind = GroupKind::Higher { trial: structure.trials.len() };
                structure.trials.push(trial);
            }
        }
        Ok(structure)
    }

    fn assemble(mechanism: &Mechanism, mobility: Mobility, nodes: &Nodes, game: &Game) -> Self {
        let component = components(game);
        let count = component.iter().copied().max().map_or(0, |m| m + 1);
        let mut members: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (node, &c) in component.iter().enumerate() {
            members[c].push(node);
        }
        let needed: Vec<Vec<usize>> = (0..count)
            .map(|c| {
                let mut list: Vec<usize> = members[c]
                    .iter()
                    .flat_map(|&node| game.pays[node].iter().map(move |&e| game.edges[e].other(node)))
                    .map(|other| component[other])
                    .filter(|&other| other != c)
                    .collect();
                list.sort_unstable();
                list.dedup();
                list
            })
            .collect();
        // Solve what can be solved, the lowest link first. A joint that rides on one solved link needs no
        // group of its own; it belongs to that link's.
        let frame = component[FRAME];
        let mut group_of_component: Vec<Option<Option<usize>>> = vec![None; count];
        group_of_component[frame] = Some(None);
        let pinned =
            |node: usize| game.pays[node].iter().all(|&e| matches!(game.edges[e].joint, Joint::Pin(..)));
        let rides =
            |c: usize| members[c].iter().all(|&n| n >= nodes.links && pinned(n)) && needed[c].len() == 1;
        let mut needed_by: Vec<Vec<usize>> = vec![Vec::new(); count];
        for (c, list) in needed.iter().enumerate() {
            list.iter().for_each(|&n| needed_by[n].push(c));
        }
        let mut paid_by: Vec<Vec<Joint>> = vec![Vec::new(); count];
        for edge in &game.edges {
            paid_by[component[edge.payer]].push(edge.joint);
        }
        // How many components each has still to wait for; those that wait for none, riders first, then the lowest.
        let mut open: Vec<usize> = needed.iter().map(Vec::len).collect();
        let place = |c: usize| (!rides(c), members[c].first().copied(), c);
        let mut ready: BTreeSet<(bool, Option<usize>, usize)> =
            (0..count).filter(|&c| c != frame && open[c] == 0).map(place).collect();
        let mut found = vec![frame];
        let mut groups: Vec<Group> = Vec::new();
        loop {
            for n in found.drain(..) {
                for &c in &needed_by[n] {
                    open[c] -= 1;
                    if open[c] == 0 {
                        ready.insert(place(c));
                    }
                }
            }
            let Some((is_group, _, c)) = ready.pop_first() else { break };
            found.push(c);
            if !is_group {
                group_of_component[c] = group_of_component[needed[c][0]];
                continue;
            }
            let links: Vec<LinkId> =
                members[c].iter().filter(|&&n| n < nodes.links).map(|&n| LinkId(n)).collect();
            let points: Vec<PointId> = members[c]
                .iter()
                .filter_map(|&n| nodes.points.get(n.wrapping_sub(nodes.links)))
                .copied()
                .collect();
            let mut joints: Vec<Joint> = Vec::new();
            for joint in &paid_by[c] {
                if !joints.contains(joint) {
                    joints.push(*joint);
                }
            }
            let mut after: Vec<usize> =
                needed[c].iter().filter_map(|&n| group_of_component[n].flatten()).collect();
            after.sort_unstable();
            after.dedup();
            let kind = classify(mechanism, &links, &points, &joints);
            group_of_component[c] = Some(Some(groups.len()));
            groups.push(Group { links, points, joints, kind, after });
        }
        let group_of = (0..nodes.links).map(|link| group_of_component[component[link]].flatten()).collect();
        let mut joint_of = vec![None; mechanism.points.len()];
        for (index, group) in groups.iter().enumerate().rev() {
            group.points.iter().for_each(|point| joint_of[point.0] = Some(index));
        }
        Self { mobility, groups, group_of, trials: Vec::new(), joint_of }
    }

    /// The rolling pairs that keep their bodies in contact.
    #[must_use]
    pub fn contacts(&self) -> Vec<usize> {
        let joints = self.groups.iter().flat_map(|group| &group.joints);
        joints.filter_map(|joint| if let Joint::Contact(roll) = *joint { Some(roll) } else { None }).collect()
    }

    /// The ways in which a group of higher class can be tried, so many at most; that of [`Structure::trials`] first.
    /// Which of them tells something depends on where the mechanism stands: what is driven may be unable to move what
    /// is left open.
    #[must_use]
    pub fn ways_to_try(&self, mechanism: &Mechanism, trial: usize, most: usize) -> Vec<Trial> {
        let kind = GroupKind::Higher { trial };
        let Some(group) = self.groups.iter().find(|group| group.kind == kind) else { return Vec::new() };
        let held = self.contacts();
        let further = Trial::further_ways(mechanism, &held, group).take(most);
        let by_rides = Trial::ways_by_rides(mechanism, &held, group).take(most);
        Trial::ways(mechanism, &held, group).take(most).chain(further).chain(by_rides).collect()
    }

    /// The ways in which a group of higher class can be tried where it stands and those of [`Structure::ways_to_try`] tell
    /// nothing of its motion: by two drivers, so many pairs at most.
    #[must_use]
    pub fn last_ways_to_try(&self, mechanism: &Mechanism, trial: usize, most: usize) -> Vec<Trial> {
        let kind = GroupKind::Higher { trial };
        let group = self.groups.iter().find(|group| group.kind == kind);
        group.map_or_else(Vec::new, |group| Trial::last_ways(mechanism, &self.contacts(), group, most))
    }

    /// The group that solves a link; `None` for the frame.
    #[must_use]
    pub fn group_of(&self, link: LinkId) -> Option<usize> {
        self.group_of[link.0]
    }

    /// The group that finds a point: that which it is a joint of, whether or not it lies on a link; else the first
    /// that solves a link on which it rides. `None` for a point of the frame.
    #[must_use]
    pub fn group_finding(&self, mechanism: &Mechanism, point: PointId) -> Option<usize> {
        if mechanism.is_fixed(point) {
            return None;
        }
        let own = self.joint_of.get(point.0).copied().flatten();
        own.or_else(|| mechanism.point(point).links.iter().filter_map(|&link| self.group_of(link)).min())
    }
}

/// Every pair as (joint, the two nodes, number of constraints).
fn constraints(mechanism: &Mechanism, nodes: &Nodes) -> Vec<(Joint, [usize; 2], usize)> {
    let mut list = Vec::new();
    for &point in &nodes.points {
        for &link in &mechanism.point(point).links {
            if let Some(node) = nodes.point(point) {
                list.push((Joint::Pin(link, point), [link.0, node], POINT_FREEDOMS));
            }
        }
    }
    for (index, slide) in mechanism.slides.iter().enumerate() {
        let count = if matches!(slide.rider, Rider::Pin { block: None, .. }) { 1 } else { 2 };
        list.push((Joint::Slide(index), slide_ends(mechanism, nodes, index), count));
    }
    for (index, roll) in mechanism.rolls.iter().enumerate() {
        list.push((Joint::Roll(index), roll_ends(roll), 1));
    }
    list
}

fn roll_ends(roll: &Roll) -> [usize; 2] {
    match roll {
        Roll::Circles { links, .. } => [links[0].0, links[1].0],
        Roll::Line { guide, wheel, .. } => [guide.link.0, wheel.0],
    }
}

/// What a contact holds together: the distance of two centres, or of a centre from the body of a line. Whoever has
/// a centre as a joint is held by it; how a wheel turns about it is another matter.
fn contact_ends(nodes: &Nodes, roll: &Roll) -> [usize; 2] {
    let node = |centre: PointId, wheel: LinkId| nodes.point(centre).unwrap_or(wheel.0);
    match *roll {
        Roll::Circles { links, centres, .. } => [0, 1].map(|side| node(centres[side], links[side])),
        Roll::Line { guide, wheel, centre, .. } => [guide.link.0, node(centre, wheel)],
    }
}

/// Whether other pairs hold two rolling bodies together: one link has both centres, or one centre rides on an
/// arc about the other; the wheel's centre rides on the body of the line, or that body slides without turning
/// against a link that has the centre.
#[must_use]
pub fn holds_distance(mechanism: &Mechanism, roll: &Roll) -> bool {
    let has = |link: LinkId, point: PointId| mechanism.point(point).links.contains(&link);
    match roll {
        Roll::Circles { centres, .. } => {
            let second = &mechanism.point(centres[1]).links;
            mechanism.point(centres[0]).links.iter().any(|l| second.contains(l))
                || mechanism.slides.iter().any(|slide| match (slide.rider, slide.guide.path) {
                    (Rider::Pin { point, .. }, Path::Arc { centre: GuidePoint::Point(about), .. }) => {
                        [point, about] == *centres || [about, point] == *centres
                    }
                    _ => false,
                })
        }
        Roll::Line { guide, centre, .. } => mechanism.slides.iter().any(|slide| {
            let held = match slide.rider {
                Rider::Pin { point, .. } => slide.guide.link == guide.link && point == *centre,
                Rider::Link { link, .. } => [[link, slide.guide.link], [slide.guide.link, link]]
                    .into_iter()
                    .any(|[body, other]| body == guide.link && has(other, *centre)),
            };
            held && is_straight(slide.guide)
        }),
    }
}

fn input_ends(mechanism: &Mechanism, nodes: &Nodes, input: &Input) -> [usize; 2] {
    match input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => [FRAME, link.0],
        Input::Slide { slide, .. } => slide_ends(mechanism, nodes, *slide),
    }
}

fn slide_ends(mechanism: &Mechanism, nodes: &Nodes, slide: usize) -> [usize; 2] {
    let Slide { rider, guide } = mechanism.slides[slide];
    let rider = match rider {
        Rider::Pin { block: Some(link), .. } | Rider::Link { link, .. } => link.0,
        Rider::Pin { point, block: None } => nodes.point(point).unwrap_or(guide.link.0),
    };
    [guide.link.0, rider]
}

fn name_of(mechanism: &Mechanism, joint: Joint) -> String {
    let number = |link: LinkId| mechanism.link(link).number;
    match joint {
        Joint::Pin(link, point) => {
            format!("pin {} of link {}", mechanism.point(point).name, number(link))
        }
        Joint::Slide(index) => {
            let slide = mechanism.slides[index];
            let rider = match slide.rider {
                Rider::Pin { point, .. } => format!("pin {}", mechanism.point(point).name),
                Rider::Link { link, .. } => format!("link {}", number(link)),
            };
            format!("the slide of {rider} on link {}", number(slide.guide.link))
        }
        Joint::Roll(index) | Joint::Contact(index) => {
            let [a, b] = roll_ends(&mechanism.rolls[index]);
            format!("the rolling of links {} and {}", mechanism.links[a].number, mechanism.links[b].number)
        }
        Joint::Trial(TrialDriver::Turn(link)) | Joint::TurnsWith(link, _) => {
            format!("the trial angle of link {}", number(link))
        }
        Joint::Trial(TrialDriver::Slide(slide)) => name_of(mechanism, Joint::Slide(slide)),
        Joint::Input(index) => match mechanism.inputs[index] {
            Input::Angle { link, .. } | Input::Speed { link, .. } => {
                format!("the input of link {}", number(link))
            }
            Input::Slide { slide, .. } => {
                format!("the input of {}", name_of(mechanism, Joint::Slide(slide)))
            }
        },
    }
}

/// An input of an angle that its pairs, or another input, say already: the count of freedoms does not tell directions
/// from places. Its index, and the link with which the driven link turns, the frame where it does not turn.
fn turned_twice(mechanism: &Mechanism) -> Option<(usize, LinkId)> {
    // Links that slide on each other without turning turn as one; the first link stands for all of them.
    let mut turns_with: Vec<usize> = (0..mechanism.links.len()).collect();
    let join = |turns_with: &mut Vec<usize>, a: usize, b: usize| {
        let (a, b) = (turns_with[a], turns_with[b]);
        turns_with.iter_mut().filter(|with| **with == a.max(b)).for_each(|with| *with = a.min(b));
    };
    for slide in mechanism.slides.iter().filter(|slide| is_straight(slide.guide)) {
        if let Rider::Link { link, .. } | Rider::Pin { block: Some(link), .. } = slide.rider {
            join(&mut turns_with, link.0, slide.guide.link.0);
        }
    }
    let mut driven: Vec<(usize, LinkId)> = vec![(FRAME, LinkId::FRAME)];
    for (index, input) in mechanism.inputs.iter().enumerate() {
        let (Input::Angle { link, .. } | Input::Speed { link, .. }) = *input else { continue };
        if let Some((_, first)) = driven.iter().find(|(with, _)| *with == turns_with[link.0]) {
            return Some((index, *first));
        }
        driven.push((turns_with[link.0], link));
    }
    None
}

/// Numbers of the links that can still move against the frame.
fn undriven(mechanism: &Mechanism, game: &mut Game) -> Vec<u32> {
    let mut links = Vec::new();
    for (node, link) in mechanism.links.iter().enumerate().skip(1) {
        game.free_frame();
        while game.free(node) == 0 && game.gather(node, FRAME) {}
        if game.free(node) > 0 {
            links.push(link.number);
        }
    }
    links
}

/// Strongly connected components of "pays for a pair with", one index per node (Tarjan, with its own
/// stack so that a long chain cannot overflow the machine's).
fn components(game: &Game) -> Vec<usize> {
    const UNSEEN: usize = usize::MAX;
    let count_of_nodes = game.pays.len();
    let next_of =
        |node: usize| -> Vec<usize> { game.pays[node].iter().map(|&e| game.edges[e].other(node)).collect() };
    let mut index = vec![UNSEEN; count_of_nodes];
    let mut low = vec![0; count_of_nodes];
    let mut component = vec![UNSEEN; count_of_nodes];
    let mut open: Vec<usize> = Vec::new();
    let (mut counter, mut count) = (0, 0);
    for root in 0..count_of_nodes {
        if index[root] != UNSEEN {
            continue;
        }
        let mut calls: Vec<(usize, Vec<usize>)> = Vec::new();
        let mut enter = Some(root);
        loop {
            if let Some(node) = enter.take() {
                index[node] = counter;
                low[node] = counter;
                counter += 1;
                open.push(node);
                calls.push((node, next_of(node)));
            }
            let Some((node, rest)) = calls.last_mut() else { break };
            let node = *node;
            if let Some(next) = rest.pop() {
                if index[next] == UNSEEN {
                    enter = Some(next);
                } else if component[next] == UNSEEN {
                    low[node] = low[node].min(index[next]);
                }
                continue;
            }
            calls.pop();
            if let Some((parent, _)) = calls.last() {
                low[*parent] = low[*parent].min(low[node]);
            }
            if low[node] == index[node] {
                while let Some(member) = open.pop() {
                    component[member] = count;
                    if member == node {
                        break;
                    }
                }
                count += 1;
            }
        }
    }
    component
}

/// Recognises the group by its pairs. A block is nothing but a way to name a pin on a guide, so it does
/// not change the kind.
fn classify(mechanism: &Mechanism, links: &[LinkId], points: &[PointId], joints: &[Joint]) -> GroupKind {
    let rods: Vec<LinkId> = links.iter().copied().filter(|&l| !mechanism.link(l).block).collect();
    let mut turned = Vec::new();
    let mut told = Vec::new();
    let mut moved = Vec::new();
    let mut slides = Vec::new();
    let mut rolls = Vec::new();
    let mut held = Vec::new();
    let mut outer = Vec::new();
    for joint in joints {
        match *joint {
            Joint::Pin(link, point) if rods.contains(&link) && !points.contains(&point) => {
                outer.push((link, point));
            }
            Joint::Pin(..) => {}
            Joint::Slide(index) => slides.push(index),
            Joint::Input(index) => match mechanism.inputs[index] {
                Input::Angle { link, .. } | Input::Speed { link, .. } => {
                    turned.push((link, Drive::Input(index)));
                }
                Input::Slide { slide, .. } => moved.push((slide, Drive::Input(index))),
            },
            Joint::Trial(tried) => match tried {
                TrialDriver::Turn(link) => turned.push((link, Drive::Trial(tried))),
                TrialDriver::Slide(slide) => moved.push((slide, Drive::Trial(tried))),
            },
            Joint::TurnsWith(link, drive) => {
                told.push(link);
                turned.push((link, drive));
            }
            Joint::Roll(index) => rolls.push(index),
            Joint::Contact(index) => held.push(index),
        }
    }
    // What rides on a solved link says itself how it turns.
    let rides = |link: LinkId| slides.iter().any(|&slide| glider(mechanism, &rods, slide) == Some(link));
    turned.retain(|&(link, _)| !told.contains(&link) || !rides(link));
    if let ([], &[roll], &[rod], &[(_, base)], [], []) = (
        rolls.as_slice(),
        held.as_slice(),
        rods.as_slice(),
        outer.as_slice(),
        turned.as_slice(),
        slides.as_slice(),
    ) && moved.is_empty()
    {
        return leaning(mechanism, (rod, base), points, roll);
    }
    if let ([], &[roll], &[link], [], [], &[ride]) = (
        rolls.as_slice(),
        held.as_slice(),
        rods.as_slice(),
        outer.as_slice(),
        turned.as_slice(),
        slides.as_slice(),
    ) && moved.is_empty()
        && glider(mechanism, &rods, ride) == Some(link)
        && let Some((wheel, centre)) = carried_centre(mechanism, link, roll)
        && points.iter().all(|&p| p == centre)
    {
        return GroupKind::RidingCentre { link, ride, wheel, centre, roll };
    }
    if let ([], [], [], &[centre]) = (rolls.as_slice(), rods.as_slice(), turned.as_slice(), points)
        && !held.is_empty()
        && moved.is_empty()
    {
        let contacts = held.iter().filter_map(|&roll| {
            let wheel = wheel_about(&mechanism.rolls[roll], centre)?;
            Some(Hold::Contact { roll, wheel })
        });
        let rides = |slide: usize| matches!(mechanism.slides[slide].rider, Rider::Pin { point, .. } if point == centre);
        let guides = slides.iter().filter(|&&slide| rides(slide)).map(|&slide| Hold::Slide(slide));
        return match contacts.chain(guides).collect::<Vec<Hold>>().as_slice() {
            &[first, second] => GroupKind::HeldCentre { centre, holds: [first, second] },
            _ => GroupKind::Other,
        };
    }
    if let (&[first, second], &[(arm, base)], [_, _], &[centre]) =
        (rolls.as_slice(), outer.as_slice(), rods.as_slice(), points)
        && held.is_empty()
        && slides.is_empty()
        && turned.is_empty()
        && moved.is_empty()
    {
        let rolls = [first, second];
        let wheel = rods.iter().copied().find(|&rod| rod != arm);
        return match wheel.filter(|&wheel| {
            rolls.iter().all(|&roll| rolls_about(&mechanism.rolls[roll], (wheel, centre), base))
        }) {
            Some(wheel) => GroupKind::Planet { arm, base, wheel, centre, rolls },
            None => GroupKind::Other,
        };
    }
    if let (&[roll], &[link]) = (rolls.as_slice(), rods.as_slice()) {
        if !moved.is_empty() {
            return GroupKind::Other;
        }
        return match (outer.as_slice(), turned.as_slice(), slides.as_slice(), held.as_slice()) {
            (&[(_, centre)], [], [], []) if turns_about(&mechanism.rolls[roll], link, centre) => {
                GroupKind::Wheel { wheel: link, centre, roll }
            }
            ([], [], &[ride], []) if glider(mechanism, &rods, ride) == Some(link) && points.is_empty() => {
                match mechanism.rolls[roll] {
                    Roll::Line { guide, .. } if guide.link == link => GroupKind::Rack { link, ride, roll },
                    _ => GroupKind::Other,
                }
            }
            ([], &[(_, input)], [], &[held]) if held == roll && lies_on(&mechanism.rolls[roll], link) => {
                driven_rack(mechanism, link, points, (roll, input))
            }
            // What another contact holds is not told by the pair it rolls in alone: how hard it presses stands at that one.
            ([], &[(_, input)], guides, contacts)
                if guides.len() + contacts.len() == 1 && contacts.iter().all(|held| *held == roll) =>
            {
                driven_wheel(mechanism, link, points, (roll, guides.first().copied(), input))
            }
            _ => GroupKind::Other,
        };
    }
    if let (true, &[(link, input)], [], [], true) =
        (rolls.is_empty(), turned.as_slice(), moved.as_slice(), outer.as_slice(), !held.is_empty())
    {
        let slides = slides.iter().map(|&slide| Hold::Slide(slide));
        let contacts = held.iter().filter_map(|&roll| contact_of_bar(mechanism, link, roll));
        let holds: Vec<Hold> = slides.chain(contacts).collect();
        return match holds.as_slice() {
            &[first, second] if held.len() < 3 => {
                driven_bar(mechanism, &rods, points, [first, second], (link, input))
            }
            _ => GroupKind::Other,
        };
    }
    if let (true, true, Some(driven)) = (
        rolls.is_empty(),
        turned.is_empty(),
        driven_pin(mechanism, &rods, points, (&slides, &moved), (&held, &outer)),
    ) {
        return driven;
    }
    if !rolls.is_empty() || !held.is_empty() {
        return GroupKind::Other;
    }
    if let (&[(link, input @ Drive::Input(_))], [], false) =
        (turned.as_slice(), moved.as_slice(), outer.is_empty())
        && outer.iter().all(|&(rod, _)| rod != link)
    {
        // A guide first: then it is the arc about the rod's pin that is struck elsewhere.
        let rods_of = outer.iter().map(|&(rod, base)| Hold::Rod { rod, base });
        let holds: Vec<Hold> = slides.iter().map(|&slide| Hold::Slide(slide)).chain(rods_of).collect();
        return match holds.as_slice() {
            &[first, second] => driven_bar(mechanism, &rods, points, [first, second], (link, input)),
            _ => GroupKind::Other,
        };
    }
    match (turned.as_slice(), moved.as_slice()) {
        ([], []) => {}
        (&[(_, input)], []) => {
            return match (rods.as_slice(), points, slides.as_slice(), outer.as_slice()) {
                ([_], [], [], &[(_, base)]) => GroupKind::Driver { base, input },
                (_, _, &[first, second], []) => {
                    let holds = [Hold::Slide(first), Hold::Slide(second)];
                    driven_bar(mechanism, &rods, points, holds, (turned[0].0, input))
                }
                _ => GroupKind::Other,
            };
        }
        ([], &[(driven, input)]) => {
            let sought = |link: LinkId| rods.contains(&link);
            return match (rods.as_slice(), points, slides.as_slice(), outer.as_slice()) {
                ([], _, &[slide], []) | ([_], [], &[slide], [])
                    if slide == driven && !sought(mechanism.slides[slide].guide.link) =>
                {
                    GroupKind::DrivenSlide { slide, input }
                }
                _ => GroupKind::Other,
            };
        }
        _ => return GroupKind::Other,
    }
    match (rods.as_slice(), points, slides.as_slice()) {
        (&[first, second], &[pin], []) => match outer.as_slice() {
            &[(a, base_a), (b, base_b)] if a != b => {
                let bases = if a == first { [base_a, base_b] } else { [base_b, base_a] };
                GroupKind::Rrr { links: [first, second], bases, pin }
            }
            _ => GroupKind::Other,
        },
        (&[rod], &[pin], &[slide]) => match (outer.as_slice(), mechanism.slides[slide].rider) {
            (&[(_, base)], Rider::Pin { point, .. }) if point == pin => {
                GroupKind::Rrp { rod, base, pin, slide, rider: None }
            }
            _ => GroupKind::Other,
        },
        (&[_, _], &[pin], &[slide]) => match (outer.as_slice(), glider(mechanism, &rods, slide)) {
            (&[(rod, base)], Some(rider)) if rider != rod => {
                GroupKind::Rrp { rod, base, pin, slide, rider: Some(rider) }
            }
            _ => GroupKind::Other,
        },
        (_, &[pin], &[first, second]) if outer.is_empty() => {
            let slides = [first, second];
            let riders = slides.map(|slide| glider(mechanism, &rods, slide));
            let rides = |slide: usize| match mechanism.slides[slide].rider {
                Rider::Pin { point, .. } => point == pin,
                Rider::Link { .. } => glider(mechanism, &rods, slide).is_some(),
            };
            let all_ride = slides.into_iter().all(rides) && riders[0] != riders[1] || rods.is_empty();
            if all_ride && riders.iter().flatten().count() == rods.len() {
                GroupKind::Prp { pin, slides, riders }
            } else {
                GroupKind::Other
            }
        }
        (&[lever], [], &[slide]) => {
            let Slide { rider, guide } = mechanism.slides[slide];
            match (outer.as_slice(), rider) {
                (&[(_, base)], Rider::Pin { point, .. }) if guide.link == lever => {
                    GroupKind::Rpr { lever, base, pin: point, slide, rod: None }
                }
                _ => GroupKind::Other,
            }
        }
        (&[a, b], [], &[slide]) => {
            let Slide { rider, guide } = mechanism.slides[slide];
            let pins = [a, b].map(|link| outer.iter().find(|(l, _)| *l == link).map(|(_, p)| *p));
            let lever_is_a = guide.link == a;
            match (rider, pins, outer.len()) {
                (Rider::Link { link, .. }, [Some(on_a), Some(on_b)], 2)
                    if [a, b].contains(&guide.link) && [a, b].contains(&link) && is_straight(guide) =>
                {
                    let (lever, rod) = if lever_is_a { (a, b) } else { (b, a) };
                    let (base, pin) = if lever_is_a { (on_a, on_b) } else { (on_b, on_a) };
                    GroupKind::Rpr { lever, base, pin, slide, rod: Some(rod) }
                }
                _ => GroupKind::Other,
            }
        }
        (&[a, b], [], &[first, second]) => {
            let Some(&(lever, base)) = outer.first().filter(|_| outer.len() == 1) else {
                return GroupKind::Other;
            };
            let link = if lever == a { b } else { a };
            let (ride, slot) =
                if glider(mechanism, &rods, first) == Some(link) { (first, second) } else { (second, first) };
            let between = matches!(mechanism.slides[slot],
                Slide { rider: Rider::Link { link: rider, .. }, guide }
                    if rods.contains(&rider) && rods.contains(&guide.link));
            match mechanism.link(link).points.first() {
                Some(&point) if between && glider(mechanism, &rods, ride) == Some(link) => {
                    GroupKind::Rpp { link, point, lever, base, ride, slot }
                }
                _ => GroupKind::Other,
            }
        }
        (&[link], [], &[first, second]) if outer.is_empty() => {
            let pair = |ride: usize, slot: usize| {
                let on = mechanism.slides[slot];
                match (glider(mechanism, &rods, ride), on.rider) {
                    (Some(_), Rider::Pin { point, .. }) if on.guide.link == link => {
                        Some(GroupKind::Yoke { link, ride, pin: point, slot })
                    }
                    _ => None,
                }
            };
            let both = [first, second].iter().all(|&slide| glider(mechanism, &rods, slide).is_some());
            let on_both = mechanism.link(link).points.first().filter(|_| both).map(|&pin| GroupKind::Prp {
                pin,
                slides: [first, second],
                riders: [Some(link); 2],
            });
            pair(first, second).or_else(|| pair(second, first)).or(on_both).unwrap_or(GroupKind::Other)
        }
        _ => GroupKind::Other,
    }
}

/// A pin that is driven along a lever about a solved pin, or along two of them, and held besides: by a rod, on a guide, or as
/// the centre of a wheel that rolls.
fn driven_pin(
    mechanism: &Mechanism,
    rods: &[LinkId],
    points: &[PointId],
    (slides, moved): (&[usize], &[(usize, Drive)]),
    (held, outer): (&[usize], &[(LinkId, PointId)]),
) -> Option<GroupKind> {
    let &[pin] = points else { return None };
    let has_pin = |link: LinkId| mechanism.point(pin).links.contains(&link);
    let base_of =
        |link: LinkId| match outer.iter().filter(|(of, _)| *of == link).collect::<Vec<_>>().as_slice() {
            &[&(_, base)] => Some(base),
            _ => None,
        };
    // Each with the link that has the pin and slides.
    let by_slide = |&slide: &usize| {
        let Slide { rider, guide } = mechanism.slides[slide];
        let drive = moved.iter().find(|(driven, _)| *driven == slide);
        let ram =
            |lever: LinkId, input: usize| Some(Hold::Ram(Ram { lever, base: base_of(lever)?, slide, input }));
        match (rider, drive) {
            (Rider::Pin { point, .. }, None) => {
                (point == pin && !rods.contains(&guide.link)).then_some((Hold::Slide(slide), None))
            }
            (Rider::Link { .. }, None) => glider(mechanism, rods, slide)
                .filter(|&rider| has_pin(rider))
                .map(|rider| (Hold::Slide(slide), Some(rider))),
            (_, Some(_)) if !is_straight(guide) || !rods.contains(&guide.link) => None,
            (Rider::Pin { point, .. }, Some(&(_, Drive::Input(input)))) if point == pin => {
                Some((ram(guide.link, input)?, None))
            }
            (Rider::Link { link, .. }, Some(&(_, Drive::Input(input)))) if rods.contains(&link) => {
                let (lever, partner) = if has_pin(link) { (guide.link, link) } else { (link, guide.link) };
                (has_pin(partner) && !has_pin(lever)).then_some((ram(lever, input)?, Some(partner)))
            }
            _ => None,
        }
    };
    let found: Vec<(Hold, Option<LinkId>)> = slides.iter().filter_map(by_slide).collect();
    let levers = || found.iter().filter_map(|(hold, _)| hold.ram().map(|ram| ram.lever));
    let arms = outer.iter().filter(|&&(rod, _)| levers().all(|lever| lever != rod));
    let arms = arms.map(|&(rod, base)| (Hold::Rod { rod, base }, None));
    let contacts = held.iter().filter_map(|&roll| {
        let wheel = wheel_about(&mechanism.rolls[roll], pin)?;
        Some((Hold::Contact { roll, wheel }, None))
    });
    let mut holds: Vec<(Hold, Option<LinkId>)> = found.iter().copied().chain(arms).chain(contacts).collect();
    holds.sort_by_key(|(hold, _)| hold.ram().is_none());
    let &[(first, with), (second, other)] = holds.as_slice() else { return None };
    let all: BTreeSet<LinkId> = levers()
        .chain([first, second].iter().filter_map(|hold| hold.rod().map(|(rod, _)| rod)))
        .chain(with)
        .chain(other)
        .collect();
    let touching = [first, second].iter().filter(|hold| matches!(hold, Hold::Contact { .. })).count();
    let whole = found.len() == slides.len()
        && touching == held.len()
        && first.ram().is_some()
        && all.len() == rods.len();
    let arms_have = [first, second].iter().all(|hold| hold.rod().is_none_or(|(rod, _)| has_pin(rod)));
    let based = |hold: &&Hold| hold.ram().is_some() || hold.rod().is_some();
    let each = outer.len() == [first, second].iter().filter(based).count();
    (whole && arms_have && each && moved.iter().all(|(slide, _)| slides.contains(slide)))
        .then_some(GroupKind::Driven { pin, holds: [first, second], riders: [with, other] })
}

/// The wheel and the centre of a rolling pair that a link carries, where it carries one of them only.
fn carried_centre(mechanism: &Mechanism, link: LinkId, roll: usize) -> Option<(LinkId, PointId)> {
    let sides: Vec<(LinkId, PointId)> = match mechanism.rolls[roll] {
        Roll::Circles { links, centres, .. } => vec![(links[0], centres[0]), (links[1], centres[1])],
        Roll::Line { guide, .. } if guide.link == link => Vec::new(),
        Roll::Line { wheel, centre, .. } => vec![(wheel, centre)],
    };
    let carried = |&(_, centre): &(LinkId, PointId)| mechanism.link(link).points.contains(&centre);
    match sides.into_iter().filter(carried).collect::<Vec<_>>().as_slice() {
        &[one] => Some(one),
        _ => None,
    }
}

/// The wheel of a rolling pair whose circle has this centre.
fn wheel_about(roll: &Roll, centre: PointId) -> Option<LinkId> {
    match *roll {
        Roll::Circles { links, centres, .. } => {
            (0..2).find(|&side| centres[side] == centre).map(|side| links[side])
        }
        Roll::Line { wheel, centre: own, .. } => (own == centre).then_some(wheel),
    }
}

/// A link that is pinned to a solved one and held by a contact: by a centre that it carries, or by its line.
fn leaning(
    mechanism: &Mechanism,
    (link, base): (LinkId, PointId),
    points: &[PointId],
    roll: usize,
) -> GroupKind {
    let sides: Vec<(LinkId, PointId)> = match mechanism.rolls[roll] {
        Roll::Circles { links, centres, .. } => vec![(links[0], centres[0]), (links[1], centres[1])],
        Roll::Line { wheel, centre, .. } => vec![(wheel, centre)],
    };
    let carried = |centre: PointId| centre != base && mechanism.link(link).points.contains(&centre);
    match (mechanism.rolls[roll], points) {
        (Roll::Line { guide, wheel, centre, .. }, []) if guide.link == link => {
            GroupKind::PinnedRack { link, base, wheel, centre, roll }
        }
        (_, [] | [_]) => match sides.into_iter().find(|&(_, centre)| carried(centre)) {
            Some((wheel, centre)) if points.iter().all(|&p| p == centre) => {
                GroupKind::Rolling { rod: link, base, wheel, centre, roll }
            }
            _ => GroupKind::Other,
        },
        _ => GroupKind::Other,
    }
}

/// The link of a group that slides without turning against a solved link: it rides on a guide of that link,
/// or carries the guide on which that link rides.
fn glider(mechanism: &Mechanism, rods: &[LinkId], slide: usize) -> Option<LinkId> {
    let Slide { rider: Rider::Link { link, .. }, guide } = mechanism.slides[slide] else { return None };
    match (rods.contains(&link), rods.contains(&guide.link)) {
        (true, false) => Some(link),
        (false, true) => Some(guide.link),
        _ => None,
    }
}

/// The contact that holds a driven link, with the wheel whose centre it holds.
fn contact_of_bar(mechanism: &Mechanism, link: LinkId, roll: usize) -> Option<Hold> {
    match mechanism.rolls[roll] {
        Roll::Line { guide, wheel, .. } if guide.link == link => Some(Hold::Contact { roll, wheel }),
        _ => carried_centre(mechanism, link, roll).map(|(wheel, _)| Hold::Contact { roll, wheel }),
    }
}

/// A driven link that two pairs hold.
fn driven_bar(
    mechanism: &Mechanism,
    rods: &[LinkId],
    points: &[PointId],
    holds: [Hold; 2],
    (link, input): (LinkId, Drive),
) -> GroupKind {
    let on_bar = |pin: PointId| mechanism.link(link).points.contains(&pin);
    // The pin, the link that rides for it, and whether it is a solved pin on a guide of the link.
    let by_slide = |slide: usize| match (mechanism.slides[slide], glider(mechanism, rods, slide)) {
        (Slide { rider: Rider::Pin { point, .. }, guide }, _) if guide.link == link => {
            (!points.contains(&point) && !on_bar(point)).then_some((Hold::Slide(slide), point, None, true))
        }
        (Slide { rider: Rider::Pin { point, .. }, guide }, _) if !rods.contains(&guide.link) => {
            on_bar(point).then_some((Hold::Slide(slide), point, None, false))
        }
        (_, Some(rider)) if rider != link => {
            let shared = |p: &PointId| mechanism.point(*p).links.contains(&rider) && on_bar(*p);
            points.iter().copied().find(shared).map(|pin| (Hold::Slide(slide), pin, Some(rider), false))
        }
        _ => None,
    };
    let hold = |hold: Hold| match hold {
        Hold::Slide(slide) => by_slide(slide),
        Hold::Contact { roll, wheel } => match mechanism.rolls[roll] {
            Roll::Line { guide, centre, .. } if guide.link == link => (!points.contains(&centre)
                && !on_bar(centre))
            .then_some((Hold::Contact { roll, wheel }, centre, None, true)),
            _ => carried_centre(mechanism, link, roll)
                .map(|(wheel, centre)| (Hold::Contact { roll, wheel }, centre, None, false)),
        },
        Hold::Ram(_) => None,
        Hold::Rod { rod, .. } => {
            let shared = |p: &PointId| mechanism.point(*p).links.contains(&rod) && on_bar(*p);
            points.iter().copied().find(shared).map(|pin| (hold, pin, None, false))
        }
    };
    let (Some(first), Some(second)) = (hold(holds[0]), hold(holds[1])) else { return GroupKind::Other };
    let [first, second] = if first.3 && !second.3 { [second, first] } else { [first, second] };
    let found = if first.3 { mechanism.link(link).points.first().copied() } else { Some(first.1) };
    let own = |point: &PointId| [first, second].iter().any(|hold| !hold.3 && hold.1 == *point);
    let riders = [first.2, second.2];
    let arms = holds.into_iter().filter(|hold| hold.rod().is_some()).count();
    if arms > 0 && (first.3 || second.3) {
        return GroupKind::Other;
    }
    match found {
        Some(point)
            if (first.1 != second.1 || first.3 != second.3)
                && points.iter().all(own)
                && rods.len() == 1 + arms + riders.iter().flatten().count() =>
        {
            GroupKind::DrivenBar {
                link,
                point,
                pins: [first.1, second.1],
                holds: [first.0, second.0],
                riders,
                under: [first.3, second.3],
                input,
            }
        }
        _ => GroupKind::Other,
    }
}

/// A driven wheel whose centre is free but for its rolling, or rides on a guide of a solved link.
fn driven_wheel(
    mechanism: &Mechanism,
    wheel: LinkId,
    points: &[PointId],
    (roll, guide, input): (usize, Option<usize>, Drive),
) -> GroupKind {
    let centre = match mechanism.rolls[roll] {
        Roll::Circles { links, centres, .. } => (0..2).find(|&i| links[i] == wheel).map(|i| centres[i]),
        Roll::Line { wheel: own, centre, .. } => (own == wheel).then_some(centre),
    };
    let Some(centre) = centre.filter(|c| points.iter().all(|p| p == c)) else {
        return GroupKind::Other;
    };
    let rides = |slide: usize| {
        let Slide { rider, guide } = mechanism.slides[slide];
        matches!(rider, Rider::Pin { point, .. } if point == centre) && guide.link != wheel
    };
    if guide.is_none_or(rides) {
        GroupKind::DrivenWheel { wheel, centre, roll, guide, input }
    } else {
        GroupKind::Other
    }
}

/// Whether it is a line of this link that rolls.
fn lies_on(roll: &Roll, link: LinkId) -> bool {
    matches!(roll, Roll::Line { guide, .. } if guide.link == link)
}

/// A driven link whose line rolls on a wheel, which nothing else holds.
fn driven_rack(
    mechanism: &Mechanism,
    link: LinkId,
    points: &[PointId],
    (roll, input): (usize, Drive),
) -> GroupKind {
    match mechanism.rolls[roll] {
        Roll::Line { wheel, centre, .. }
            if points.is_empty() && !mechanism.link(link).points.contains(&centre) =>
        {
            GroupKind::DrivenRack { link, wheel, centre, roll, input }
        }
        _ => GroupKind::Other,
    }
}

fn is_straight(guide: Guide) -> bool {
    matches!(guide.path, Path::Straight { .. })
}

/// Whether the wheel's circle in a rolling pair has this centre.
fn turns_about(roll: &Roll, wheel: LinkId, centre: PointId) -> bool {
    match roll {
        Roll::Circles { links, centres, .. } => {
            (0..2).any(|side| links[side] == wheel && centres[side] == centre)
        }
        Roll::Line { wheel: own, centre: its, .. } => *own == wheel && *its == centre,
    }
}

/// Whether a wheel about its centre rolls on a circle about another point.
fn rolls_about(roll: &Roll, wheel: (LinkId, PointId), about: PointId) -> bool {
    match *roll {
        Roll::Circles { links, centres, .. } => {
            (0..2).any(|side| (links[side], centres[side]) == wheel && centres[1 - side] == about)
        }
        Roll::Line { .. } => false,
    }
}

/// How many drivers and open constraints a group is tried with, at most, where one of each does not do.
const TRIED_TOGETHER: usize = 12;

impl Trial {
    /// The ways to drive something and to leave as much open, so that the rest can be constructed; with one of each,
    /// or where that does not do with two. They are looked for one after the other.
    fn ways<'a>(
        mechanism: &'a Mechanism,
        held: &'a [usize],
        group: &'a Group,
    ) -> impl Iterator<Item = Self> + 'a {
        let mut drivers = Self::drivers(mechanism, group);
        let mut closings = closings(mechanism, group);
        let pairs: Vec<Vec<(TrialDriver, Closing)>> = closings
            .iter()
            .flat_map(|&(closing, _)| drivers.iter().map(move |&(driver, _)| vec![(driver, closing)]))
            .collect();
        // What is pinned to a solved link and what depends on one come first in both lists.
        drivers.truncate(TRIED_TOGETHER);
        closings.truncate(TRIED_TOGETHER);
        let falls_apart = |drivers: Vec<(TrialDriver, Closing)>| {
            let groups = subgroups(mechanism, held, group, &drivers, &Turning::default())?;
            Some(Self { drivers, groups }).filter(|trial| !trial.drives_a_rack())
        };
        let mut single = pairs.into_iter().filter_map(falls_apart).peekable();
        let double = if single.peek().is_some() { Vec::new() } else { by_twos(&drivers, &closings) };
        single.chain(double.into_iter().filter_map(falls_apart))
    }

    /// The ways in which a rack of the group is turned while it rolls on a wheel. They come after all others, for they tell
    /// more only where those tell nothing: a crank to which the rack is pinned cannot turn it while the pin stands square
    /// above the contact.
    fn ways_by_racks<'a>(
        mechanism: &'a Mechanism,
        held: &'a [usize],
        group: &'a Group,
    ) -> impl Iterator<Item = Self> + 'a {
        let racks = group.joints.iter().any(|joint| match *joint {
            Joint::Roll(roll) => group.links.iter().any(|&link| lies_on(&mechanism.rolls[roll], link)),
            _ => false,
        });
        let (drivers, closings) = if racks {
            (Self::drivers(mechanism, group), closings(mechanism, group))
        } else {
            (Vec::new(), Vec::new())
        };
        let pairs: Vec<(TrialDriver, Closing)> = closings
            .iter()
            .flat_map(|&(closing, _)| drivers.iter().map(move |&(driver, _)| (driver, closing)))
            .collect();
        pairs.into_iter().filter_map(|pair| {
            let drivers = vec![pair];
            let groups = subgroups(mechanism, held, group, &drivers, &Turning::default())?;
            Some(Self { drivers, groups }).filter(Self::drives_a_rack)
        })
    }

    /// The ways in which links of the group turn with one whose turning is known: with nothing tried, or one thing.
    fn ways_by_turning<'a>(
        mechanism: &'a Mechanism,
        held: &'a [usize],
        group: &'a Group,
    ) -> impl Iterator<Item = Self> + 'a {
        let mut ways: Vec<Vec<(TrialDriver, Closing)>> = Vec::new();
        if rides_of(mechanism, group).next().is_some() {
            let drivers = Self::drivers(mechanism, group);
            ways.push(Vec::new());
            for (closing, _) in closings(mechanism, group) {
                ways.extend(drivers.iter().map(|&(driver, _)| vec![(driver, closing)]));
            }
        }
        ways.into_iter().filter_map(|drivers| Self::knowing_turning(mechanism, held, group, drivers))
    }

    /// The ways in which a ride is left open: two links are known to turn as one, and the one is off the other's guide. They
    /// come last, for a pin or a rod is easier to see.
    fn ways_by_rides<'a>(
        mechanism: &'a Mechanism,
        held: &'a [usize],
        group: &'a Group,
    ) -> impl Iterator<Item = Self> + 'a {
        let drivers = Self::drivers(mechanism, group);
        open_rides(mechanism, group)
            .flat_map(move |closing| {
                drivers.clone().into_iter().map(move |(driver, _)| vec![(driver, closing)])
            })
            .filter_map(|drivers| Self::knowing_turning(mechanism, held, group, drivers))
    }

    /// The way with these drivers, where links of the group turn with one whose turning is known.
    fn knowing_turning(
        mechanism: &Mechanism,
        held: &[usize],
        group: &Group,
        drivers: Vec<(TrialDriver, Closing)>,
    ) -> Option<Self> {
        let turning = Turning::of(mechanism, group, &drivers);
        if turning.links.is_empty() {
            return None;
        }
        let groups = subgroups(mechanism, held, group, &drivers, &turning)?;
        Some(Self { drivers, groups })
    }

    /// The ways that are tried after all others.
    fn further_ways<'a>(
        mechanism: &'a Mechanism,
        held: &'a [usize],
        group: &'a Group,
    ) -> impl Iterator<Item = Self> + 'a {
        Self::ways_by_racks(mechanism, held, group).chain(Self::ways_by_turning(mechanism, held, group))
    }

    /// Ways to drive two things and to leave two constraints open, so many pairs of things at most, for where the place of
    /// the mechanism is known and all other ways tell nothing: each of their dyads may stand at a dead centre of its own, as
    /// where a guide is parallel to that of a link that slides. Those in which least is left to be constructed come first.
    /// What is driven may be a rider on a guide of a sought link, too; and each driver may be found by either constraint.
    fn last_ways(mechanism: &Mechanism, held: &[usize], group: &Group, most: usize) -> Vec<Self> {
        let mut drivers = Self::drivers(mechanism, group);
        drivers.extend(riders_on_sought_links(mechanism, group));
        let mut closings = closings(mechanism, group);
        drivers.truncate(TRIED_TOGETHER);
        closings.truncate(TRIED_TOGETHER);
        let rides: Vec<Closing> = open_rides(mechanism, group).take(TRIED_TOGETHER).collect();
        closings.extend(rides.iter().map(|&ride| (ride, 3)));
        let is_driven = |sub: &Group| {
            matches!(
                sub.kind,
                GroupKind::Driver { .. }
                    | GroupKind::DrivenSlide { .. }
                    | GroupKind::DrivenWheel { .. }
                    | GroupKind::DrivenRack { .. }
                    | GroupKind::Wheel { .. }
            )
        };
        let mut ways: Vec<Self> = by_twos(&drivers, &closings)
            .into_iter()
            .filter_map(|drivers| {
                if drivers.iter().any(|(_, closing)| rides.contains(closing)) {
                    return Self::knowing_turning(mechanism, held, group, drivers);
                }
                let groups = subgroups(mechanism, held, group, &drivers, &Turning::default())?;
                Some(Self { drivers, groups })
            })
            .collect();
        ways.sort_by_key(|way| way.groups.iter().filter(|sub| !is_driven(sub)).count());
        ways.truncate(most);
        let either = |way: Self| {
            let (drivers, closings): (Vec<TrialDriver>, Vec<Closing>) = way.drivers.iter().copied().unzip();
            let exchanged = drivers.into_iter().zip(closings.into_iter().rev()).collect();
            [Self { drivers: exchanged, groups: way.groups.clone() }, way]
        };
        ways.into_iter().flat_map(either).collect()
    }

    /// Whether it is known of links how they turn without their being driven, or tried.
    #[must_use]
    pub fn knows_turning(&self) -> bool {
        let joints = self.groups.iter().flat_map(|group| &group.joints);
        joints.into_iter().any(|joint| matches!(joint, Joint::TurnsWith(..)))
    }

    /// Whether a link is driven whose line rolls on a wheel.
    fn drives_a_rack(&self) -> bool {
        self.groups.iter().any(|group| matches!(group.kind, GroupKind::DrivenRack { .. }))
    }

    /// What can be driven, and how good it is: links pinned to solved ones, riders on guides of solved links, other
    /// links.
    fn drivers(mechanism: &Mechanism, group: &Group) -> Vec<(TrialDriver, u8)> {
        let rod = |link: &LinkId| !mechanism.link(*link).block;
        let mut list = Vec::new();
        for joint in &group.joints {
            if let Joint::Pin(link, point) = *joint
                && group.links.contains(&link)
                && !group.points.contains(&point)
                && rod(&link)
            {
                list.push((TrialDriver::Turn(link), 0));
            }
        }
        for joint in &group.joints {
            if let Joint::Slide(slide) = *joint
                && !group.links.contains(&mechanism.slides[slide].guide.link)
            {
                let sought = match mechanism.slides[slide].rider {
                    Rider::Pin { point, .. } => group.points.contains(&point),
                    Rider::Link { link, .. } => group.links.contains(&link),
                };
                if sought {
                    list.push((TrialDriver::Slide(slide), 1));
                }
            }
        }
        for &link in group.links.iter().filter(|link| rod(link)) {
            if list.iter().all(|&(driver, _)| driver != TrialDriver::Turn(link)) {
                list.push((TrialDriver::Turn(link), 2));
            }
        }
        list
    }
}

/// Every two drivers with every two constraints that are left open.
fn by_twos(drivers: &[(TrialDriver, u8)], closings: &[(Closing, u8)]) -> Vec<Vec<(TrialDriver, Closing)>> {
    let mut all = Vec::new();
    for (index, &(first, _)) in closings.iter().enumerate() {
        for &(second, _) in &closings[index + 1..] {
            for (index, &(one, _)) in drivers.iter().enumerate() {
                for &(other, _) in &drivers[index + 1..] {
                    all.push(vec![(one, first), (other, second)]);
                }
            }
        }
    }
    all
}

/// The sought riders on guides of sought links: what is driven along them is solved once the guide is.
fn riders_on_sought_links<'a>(
    mechanism: &'a Mechanism,
    group: &'a Group,
) -> impl Iterator<Item = (TrialDriver, u8)> + 'a {
    group.joints.iter().filter_map(|joint| {
        let Joint::Slide(slide) = *joint else { return None };
        let Slide { rider, guide } = mechanism.slides[slide];
        let sought = match rider {
            Rider::Pin { point, .. } => group.points.contains(&point),
            Rider::Link { link, .. } => group.links.contains(&link),
        };
        (sought && group.links.contains(&guide.link)).then_some((TrialDriver::Slide(slide), 3))
    })
}

/// The rides among a group's pairs, each with its two links.
fn rides_of<'a>(
    mechanism: &'a Mechanism,
    group: &'a Group,
) -> impl Iterator<Item = (usize, [LinkId; 2])> + 'a {
    group.joints.iter().filter_map(|joint| match *joint {
        Joint::Slide(index) => match mechanism.slides[index] {
            Slide { rider: Rider::Link { link, .. }, guide } if is_straight(guide) => {
                Some((index, [link, guide.link]))
            }
            _ => None,
        },
        _ => None,
    })
}

/// The rides of a group as constraints that a trial leaves open.
fn open_rides<'a>(mechanism: &'a Mechanism, group: &'a Group) -> impl Iterator<Item = Closing> + 'a {
    rides_of(mechanism, group).filter_map(|(slide, [rider, _])| {
        let pin = mechanism.link(rider).points.first().copied()?;
        Some(Closing::Slide { slide, pin })
    })
}

/// What is known of a group's turning beforehand: links that slide on each other without turning turn as one.
#[derive(Debug, Default)]
struct Turning {
    /// Links, each with what says how it turns: another one that is solved, driven or tried, or its own driving.
    links: Vec<(LinkId, Drive)>,
    /// The rides by which they do so; what these say of turning is said by that.
    rides: Vec<usize>,
}

impl Turning {
    fn of(mechanism: &Mechanism, group: &Group, drivers: &[(TrialDriver, Closing)]) -> Self {
        let solved = |link: LinkId| !group.links.contains(&link);
        let own_drive = |link: LinkId| {
            let driven = group.joints.iter().find_map(|&joint| match joint {
                Joint::Input(input) if !drivers.iter().any(|&(_, closing)| is_open(closing, joint)) => {
                    turns(&mechanism.inputs[input], link).then_some(Drive::Input(input))
                }
                _ => None,
            });
            let tried = TrialDriver::Turn(link);
            let tried = drivers.iter().any(|&(driver, _)| driver == tried).then_some(Drive::Trial(tried));
            driven.or(tried)
        };
        let mut known: Vec<(LinkId, LinkId)> = Vec::new();
        for (_, ends) in rides_of(mechanism, group) {
            for link in ends.into_iter().filter(|&link| solved(link) || own_drive(link).is_some()) {
                if !known.contains(&(link, link)) {
                    known.push((link, link));
                }
            }
        }
        let mut turning = Self::default();
        loop {
            let with = |known: &[(LinkId, LinkId)], link: LinkId| {
                known.iter().find(|(of, _)| *of == link).map(|&(_, with)| with)
            };
            let next = rides_of(mechanism, group).find_map(|(ride, [a, b])| {
                match (with(&known, a), with(&known, b)) {
                    (Some(with), None) => Some((ride, b, with)),
                    (None, Some(with)) => Some((ride, a, with)),
                    _ => None,
                }
            });
            let Some((ride, link, with)) = next else { break };
            known.push((link, with));
            turning.rides.push(ride);
            turning.links.push((link, Drive::With(with)));
            if let Some(drive) = own_drive(with).filter(|_| !turning.has(with)) {
                turning.links.push((with, drive));
            }
        }
        turning
    }

    /// Whether a link is known to turn as one does.
    fn has(&self, link: LinkId) -> bool {
        self.links.iter().any(|&(of, _)| of == link)
    }
}

/// Whether an input turns a link.
fn turns(input: &Input, driven: LinkId) -> bool {
    matches!(*input, Input::Angle { link, .. } | Input::Speed { link, .. } if link == driven)
}

/// The constraints of a group that a trial may leave open, and how good they are: those to solved links first.
fn closings(mechanism: &Mechanism, group: &Group) -> Vec<(Closing, u8)> {
    let mut list = Vec::new();
    let inside = |point: &PointId| group.points.contains(point);
    for joint in &group.joints {
        if let Joint::Input(input) = *joint
            && let Input::Angle { link, .. } | Input::Speed { link, .. } = mechanism.inputs[input]
        {
            list.push((Closing::Angle { link, input }, 0));
        }
    }
    // In the order of their pins on solved links, then the others.
    let outer = group.joints.iter().filter_map(|joint| match *joint {
        Joint::Pin(link, point) if group.links.contains(&link) && !inside(&point) => Some(link),
        _ => None,
    });
    let mut rods: Vec<LinkId> = Vec::new();
    for link in outer.chain(group.links.iter().copied()) {
        if !mechanism.link(link).block && !rods.contains(&link) {
            rods.push(link);
        }
    }
    for link in rods {
        let ends: Vec<PointId> = group
            .joints
            .iter()
            .filter_map(|joint| if let Joint::Pin(l, p) = *joint { (l == link).then_some(p) } else { None })
            .collect();
        // A rod on which the group itself slides or rolls cannot be left open; what is solved later may depend on it.
        let more = group.joints.iter().any(|joint| match *joint {
            Joint::Slide(slide) => {
                let Slide { rider, guide } = mechanism.slides[slide];
                guide.link == link
                    || match rider {
                        Rider::Link { link: rider, .. } => rider == link,
                        Rider::Pin { point, block } => {
                            block.is_none() && mechanism.point(point).links == [link]
                        }
                    }
            }
            Joint::Roll(roll) => mechanism.rolls[roll].bodies().contains(&link),
            Joint::Contact(roll) => mechanism.rolls[roll].bodies().contains(&link),
            Joint::Input(input) => matches!(mechanism.inputs[input],
                Input::Angle { link: driven, .. } | Input::Speed { link: driven, .. } if driven == link),
            _ => false,
        });
        match ends.as_slice() {
            &[a, b] if !more && (inside(&a) || inside(&b)) => {
                let (near, far) = if inside(&a) { (a, b) } else { (b, a) };
                list.push((Closing::Rod { link, near, far }, if inside(&far) { 2 } else { 0 }));
            }
            _ => {}
        }
    }
    for joint in &group.joints {
        match *joint {
            Joint::Slide(slide) => {
                if let Slide { rider: Rider::Pin { point, .. }, guide } = mechanism.slides[slide] {
                    let outside = inside(&point) && !group.links.contains(&guide.link);
                    list.push((Closing::Slide { slide, pin: point }, if outside { 0 } else { 2 }));
                }
            }
            Joint::Input(input) => {
                if let Input::Slide { slide, .. } = mechanism.inputs[input] {
                    let pin = match mechanism.slides[slide].rider {
                        Rider::Pin { point, .. } => Some(point),
                        Rider::Link { link, .. } => mechanism.link(link).points.first().copied(),
                    };
                    list.extend(pin.map(|pin| (Closing::Driven { slide, pin, input }, 1)));
                }
            }
            Joint::Roll(roll) => list.push((Closing::Roll { roll }, 1)),
            Joint::Contact(roll) => {
                let (wheel, centre) = match mechanism.rolls[roll] {
                    Roll::Circles { links, centres, .. } => {
                        let side = usize::from(!inside(&centres[0]));
                        (links[side], centres[side])
                    }
                    Roll::Line { wheel, centre, .. } => (wheel, centre),
                };
                list.push((Closing::Contact { roll, wheel, centre }, 2));
            }
            _ => {}
        }
    }
    list.sort_by_key(|&(_, rank)| rank);
    list
}

/// Whether a joint is left open.
fn is_open(closing: Closing, joint: Joint) -> bool {
    match (closing, joint) {
        (Closing::Rod { link, far, .. }, Joint::Pin(l, p)) => (l, p) == (link, far),
        (Closing::Slide { slide, .. }, Joint::Slide(s)) => s == slide,
        (Closing::Angle { input, .. } | Closing::Driven { input, .. }, Joint::Input(i)) => i == input,
        (Closing::Roll { roll }, Joint::Roll(r)) => r == roll,
        (Closing::Contact { roll, .. }, Joint::Contact(r)) => r == roll,
        _ => false,
    }
}

/// The groups into which a group falls with its trial drivers driven and as many constraints open, and with what is known
/// of its turning, if all of them can be constructed.
fn subgroups(
    mechanism: &Mechanism,
    contacts: &[usize],
    group: &Group,
    drivers: &[(TrialDriver, Closing)],
    turning: &Turning,
) -> Option<Vec<Group>> {
    let nodes = Nodes::of(mechanism);
    let mut game = Game::new(&nodes);
    let open = |joint: Joint| drivers.iter().any(|&(_, closing)| is_open(closing, joint));
    for (joint, ends, count) in constraints(mechanism, &nodes) {
        let told = matches!(joint, Joint::Slide(slide) if turning.rides.contains(&slide));
        for _ in usize::from(told)..count {
            if !open(joint) && !game.insert(ends, joint) {
                return None;
            }
        }
    }
    for &(link, drive) in &turning.links {
        let from = match drive {
            Drive::With(with) if !group.links.contains(&with) => with.0,
            _ => FRAME,
        };
        if !game.insert([from, link.0], Joint::TurnsWith(link, drive)) {
            return None;
        }
    }
    for &roll in contacts {
        let ends = contact_ends(&nodes, &mechanism.rolls[roll]);
        if !open(Joint::Contact(roll)) && !game.insert(ends, Joint::Contact(roll)) {
            return None;
        }
    }
    for (index, input) in mechanism.inputs.iter().enumerate() {
        let ends = input_ends(mechanism, &nodes, input);
        let told = turning.links.iter().any(|&(_, drive)| drive == Drive::Input(index));
        if !open(Joint::Input(index)) && !told && !game.insert(ends, Joint::Input(index)) {
            return None;
        }
    }
    // What dangles from an open constraint is held by an assumed angle of its own.
    let mut held: Vec<TrialDriver> = drivers.iter().map(|&(driver, _)| driver).collect();
    let mut dangling = Vec::new();
    for &(_, closing) in drivers {
        match closing {
            Closing::Rod { link, .. } => dangling.push(link),
            Closing::Slide { slide, .. } => {
                if let Rider::Pin { block: Some(block), .. } = mechanism.slides[slide].rider {
                    dangling.push(block);
                }
            }
            Closing::Angle { .. }
            | Closing::Driven { .. }
            | Closing::Contact { .. }
            | Closing::Roll { .. } => {}
        }
    }
    held.extend(dangling.iter().map(|&link| TrialDriver::Turn(link)));
    for (index, &driver) in held.iter().enumerate() {
        if held[..index].contains(&driver) {
            return None;
        }
        let ends = match driver {
            TrialDriver::Turn(link) if turning.links.contains(&(link, Drive::Trial(driver))) => continue,
            TrialDriver::Turn(link) if turning.has(link) => return None,
            TrialDriver::Turn(link) => [FRAME, link.0],
            TrialDriver::Slide(slide) => slide_ends(mechanism, &nodes, slide),
        };
        if !game.insert(ends, Joint::Trial(driver)) {
            return None;
        }
    }
    if game.left() > 0 {
        return None;
    }
    game.free_frame();
    let mobility =
        Mobility { links: 0, turning: 0, sliding: 0, rolling: 0, higher: 0, freedoms: 0, inputs: 0 };
    let apart = Structure::assemble(mechanism, mobility, &nodes, &game);
    let mut groups: Vec<Group> = apart
        .groups
        .into_iter()
        .filter(|g| {
            let within = g.links.iter().any(|l| group.links.contains(l))
                || g.points.iter().any(|p| group.points.contains(p));
            let dangles = g.links.iter().any(|l| dangling.contains(l));
            within && !dangles
        })
        .collect();
    for sub in &mut groups {
        sub.after.clear();
    }
    let known = |g: &Group| !matches!(g.kind, GroupKind::Other | GroupKind::Higher { .. });
    // One group does where it finds every joint: what hangs on a dangling block is found by none.
    let found = |point: &PointId| {
        let on = |g: &Group| mechanism.point(*point).links.iter().any(|link| g.links.contains(link));
        groups.iter().any(|g| g.points.contains(point) || on(g))
    };
    let whole = groups.len() > 1 || !groups.is_empty() && group.points.iter().all(found);
    (whole && groups.iter().all(known)).then_some(groups)
}
