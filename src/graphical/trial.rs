//! Groups of higher class, by trial (Stephenson's six-bar driven at the wrong link, triads of eight-bars).
//!
//! No dyad of such a group is solvable alone. One of its links is driven by trial and one constraint is left
//! open; the rest then falls apart into groups that can be constructed.
//!
//! *Position*: the open end runs along its trial curve as the trial driver turns; the place where it satisfies
//! the open constraint is found on a scratch board, laid on the real one, and corrected there by one step of
//! the rule of false position, which leaves on the tape how the place depends on every given number. Trials are made over
//! the whole range of the driver, ever closer to where it has a rough place, and between two trials wherever the miss bends
//! so much that it may pass zero there unseen.
//!
//! *Velocity*: two trial polygons, with the trial driver turning at any two rates. As the rate changes, the
//! image of the open end moves along the straight line through its two trial images (every velocity is linear
//! in the rate). Where that line meets the line of the open constraint lies the image; by proportion the rate,
//! and with it the true polygon.
//!
//! *Acceleration*: in the same way, with the trial driver's angular acceleration.

use std::cell::{Cell, RefCell};

use crate::board::{Amount, Angle, Board, Line, Mm, Point, Side, found_by_trial};
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::{
    Closing, Drive, Group, GroupKind, Joint, Target, Trial, TrialDriver, Unknown,
};
use crate::mechanism::{Form, Input, Link, LinkId, Mechanism, Path, PointId, Rider};
use crate::plan::{GroupStep, trial_steps};

use super::construction::{Act, Label};
use super::draughtsman::{Draughtsman, Images};
use super::link_figure::given_lengths;
use super::missing::Missing;
use super::pose::{Pose, Track};
use super::position::chooses;
use super::{DrawError, FAR_FROM_HINT};

/// Trial angles in a whole turn.
const TRIALS: u32 = 720;
/// Trials about an expected place begin at this power of a half of the range, and end at that.
const FARTHEST: i32 = 3;
const CLOSEST: i32 = 18;
/// Between two trials it is looked closer so often, each time into four parts.
const DEEPEST_LOOK: usize = 9;
/// Trials of one range that are made to look closer, at most.
const MOST_CLOSER: usize = 2000;
/// A miss that bends by less than this part of what counts as a root is straight.
const NO_BEND: f64 = 1e-3;
/// Halvings of a bracket.
const HALVINGS: usize = 60;
/// A residual is a root, not a jump, below this part of the paper's size (100 mm).
const ROOT: f64 = 1e-4;
/// A tenth of the paper's size, millimetres.
const TENTH_OF_PAPER: f64 = 10.0;
/// A miss at the edge of what closes is a root below this part of all lengths: there it goes with the root of what is left,
/// and an angle to its last digit tells it to half of them.
const AT_EDGE: f64 = 1e-8;
/// Two roots whose places differ by less are one, millimetres.
const SAME_PLACE: f64 = 1e-4;
/// Neither is larger than this part of all lengths: a rough place far away makes everything else small on paper.
const OF_LENGTHS: f64 = 1e-6;
/// Paper length of a trial vector, millimetres.
const TRIAL_VECTOR: f64 = 50.0;
/// Assemblies that are searched for the place of a group, before other ways to try it are given up.
const MOST_ASSEMBLIES: usize = 64;
/// The same where none has led to a place yet.
const MOST_WHERE_NONE: usize = 128;
/// Ways in which a group is tried, at most.
const MOST_WAYS: usize = 6;
/// Ways to try it by two drivers, where it stands and no other tells how it moves, at most.
const MOST_LAST_WAYS: usize = 24;
/// Another way to try a group is taken for its rough places where it misses them by less than this part, in squares.
const CLEARLY: f64 = 0.25;
/// A hand's slips move what is tried by no more than this part of how far it may go at once.
const SLIPS: f64 = 0.1;
/// A rate below this part of the one that gives such a vector is too small to try others near it.
const LEAST_RATE: f64 = 1e-3;

/// A way to close the group: the trial driver's angle and the sides that its inner groups take.
#[derive(Debug, Clone)]
struct Root {
    angle: f64,
    sides: Vec<Side>,
    places: Vec<(PointId, [f64; 2])>,
}

/// What moves while a group is tried: its placed points have hints then instead of places, and its links of placed
/// points are figures to be laid on like any other.
#[derive(Debug, Clone, Default, PartialEq)]
pub(super) struct Tried {
    pub(super) points: Vec<PointId>,
    pub(super) links: Vec<LinkId>,
}

/// Ways in which groups of higher class close, kept from one drawing to the next: where nothing differs before a group, the
/// search for them, which takes almost all of the time, has the same end.
#[derive(Debug, Default)]
pub struct Searched {
    known: RefCell<Vec<Search>>,
    /// Drawings differ by the slips of hands: a group closes next to where it closed in the first of them.
    by_hands: bool,
    /// How often all ways to close a group were searched through.
    searches: Cell<u32>,
}

/// A search: everything that it hangs on, and what it found.
#[derive(Debug)]
struct Search {
    trial: Trial,
    stands: Stands,
    mechanism: Mechanism,
    found: Result<Root, DrawError>,
}

/// What stands on the skeleton before a search, as numbers.
#[derive(Debug, PartialEq)]
struct Stands {
    scale: f64,
    places: Vec<Option<[f64; 2]>>,
    pricked: Vec<Option<[f64; 2]>>,
    stated_hints: Vec<Option<[f64; 2]>>,
    poses: Vec<Option<[[f64; 2]; 4]>>,
    tried: Tried,
}

impl Searched {
    /// For many drawings of one mechanism, the first by a perfect hand and the others by hands that slip: these look for
    /// the way in which a group closes next to the perfect one, and elsewhere only where there is none.
    pub(super) fn by_hands() -> Self {
        Self { by_hands: true, ..Self::default() }
    }

    /// How often all ways to close a group were searched through: what almost all of the time goes into.
    #[cfg(test)]
    pub(super) fn searches(&self) -> u32 {
        self.searches.get()
    }

    /// The way in which a group closes, as [`Draughtsman::find_root`] finds it.
    fn root(&self, d: &mut Draughtsman<'_>, trial: &Trial) -> Result<Root, DrawError> {
        let stands = d.as_it_stands();
        let alike =
            |search: &&Search| search.trial == *trial && is_same_skeleton(&search.mechanism, d.mechanism);
        let mut perfect = None;
        for search in self.known.borrow().iter().filter(alike) {
            if search.stands == stands {
                return search.found.clone();
            }
            if self.by_hands && perfect.is_none() {
                perfect = search.found.clone().ok();
            }
        }
        let is_first = perfect.is_none();
        if let Some(near) = perfect.and_then(|perfect| d.root_near(trial, &perfect)) {
            return Ok(near);
        }
        self.searches.set(self.searches.get() + 1);
        let found = d.find_root(trial);
        // Of hands that slip no two leave a drawing at which another would begin.
        if is_first {
            let mechanism = d.mechanism.clone();
            let search = Search { trial: trial.clone(), stands, mechanism, found: found.clone() };
            self.known.borrow_mut().push(search);
        }
        found
    }
}

/// Whether two mechanisms do not differ in anything but what acts on them and is asked.
fn is_same_skeleton(one: &Mechanism, other: &Mechanism) -> bool {
    (&one.links, &one.points, &one.pins, &one.slides)
        == (&other.links, &other.points, &other.pins, &other.slides)
        && (&one.rolls, &one.contacts, &one.statements, &one.inputs)
            == (&other.rolls, &other.contacts, &other.statements, &other.inputs)
}

/// Places and poses before a trial.
struct Standing {
    places: Vec<Option<Point>>,
    poses: Vec<Option<Pose>>,
}

/// How far the record had come before a trial.
struct Mark {
    coincident: usize,
    parts: usize,
    feet: usize,
    images: Images,
}

impl<'m> Draughtsman<'m> {
    /// How a group of higher class is tried: the first way that tells something where the mechanism stands.
    pub(super) fn trial(&self, index: usize) -> Trial {
        match self.ways.get(&index) {
            Some(trial) => trial.clone(),
            None => self.structure.trials[index].clone(),
        }
    }

    /// The other ways to try a group.
    fn other_ways(&self, index: usize) -> impl Iterator<Item = Trial> + use<> {
        self.structure.ways_to_try(self.mechanism, index, MOST_WAYS).into_iter().skip(1)
    }

    /// Whether nothing can be told of a place, an image or a rate of a group's points and links because the way in
    /// which it was tried does not move what it leaves open. On scratch paper nobody knows.
    fn tells_nothing(&mut self, order: Order, trial: &Trial) -> bool {
        let mut amounts: Vec<u32> = Vec::new();
        let pole = self.board.origin();
        for point in self.points_of(trial) {
            let at = match order {
                Order::Position => self.places[point.0],
                _ => self.images(order)[point.0],
            };
            if let Some(at) = at {
                amounts.extend(self.board.between(pole, at).map(|mm| mm.mark()));
            }
        }
        let links = self.links_of_trial(trial).into_iter().chain(closing_rods(trial));
        if order != Order::Position {
            let rotations = &self.motion(order).rotations;
            amounts.extend(links.filter_map(|link| rotations[link.0].map(|rate| rate.mark())));
        }
        amounts.into_iter().any(|mark| self.board.tape().weakness(mark).is_some())
    }

    /// Points of the group's links that are not solved before it, and those of the rod that closes it.
    fn points_of(&self, trial: &Trial) -> Vec<PointId> {
        let mut points = Vec::new();
        let rods = closing_rods(trial);
        for link in trial.groups.iter().flat_map(|group| &group.links).copied().chain(rods) {
            for &point in &self.mechanism.link(link).points {
                if !self.mechanism.is_fixed(point) && !points.contains(&point) {
                    points.push(point);
                }
            }
        }
        for &point in trial.groups.iter().flat_map(|group| &group.points) {
            if !points.contains(&point) {
                points.push(point);
            }
        }
        points
    }

    /// The points at which the group closes: those that two of its links share, and pins on guides.
    fn joints_of(&self, trial: &Trial) -> Vec<PointId> {
        let rods = closing_rods(trial);
        let of_group = |link: &LinkId| {
            rods.contains(link) || trial.groups.iter().any(|group| group.links.contains(link))
        };
        let rides = |point: PointId| {
            self.mechanism.slides.iter().any(|s| matches!(s.rider, Rider::Pin { point: p, .. } if p == point))
        };
        let mut points = self.points_of(trial);
        points.retain(|&p| {
            rides(p) || self.mechanism.point(p).links.iter().filter(|link| of_group(link)).count() > 1
        });
        points
    }

    /// The points of the closing rods among these, besides the two by which each stands.
    fn on_rods(&self, trial: &Trial, points: &[(LinkId, PointId)]) -> GroupStep {
        let further = |(of, p): &&(LinkId, PointId)| {
            trial.drivers.iter().any(|&(_, closing)| {
                matches!(closing, Closing::Rod { link, near, far } if *of == link && *p != near && *p != far)
            })
        };
        GroupStep { group: 0, points: points.iter().filter(further).copied().collect() }
    }

    // --- position ------------------------------------------------------------------------------

    /// The skeleton of the group, by the first way to try it that leads to one in which the rough places hold. Where they
    /// hold in none, by the way that comes nearest to them: what one way drives cannot pass every assembly, as a pin that
    /// rides on two guides stays where they cross while the one is turned, and runs along both where they are one.
    pub(super) fn position_by_trial(&mut self, step: &GroupStep, index: usize) -> Result<(), DrawError> {
        let before = self.skeleton();
        let first = self.trial(index);
        let drawn = self.position_with(step, &first, true);
        let fails = |d: &mut Self, drawn: &Result<(), DrawError>, trial: &Trial| match drawn {
            Ok(()) => d.tells_nothing(Order::Position, trial),
            // A dyad that is stretched out where the group stands may miss by rounding.
            Err(
                DrawError::NoConstruction { .. }
                | DrawError::NoClosure { .. }
                | DrawError::CannotAssemble { .. },
            ) => true,
            Err(_) => false,
        };
        let mut nearest: Option<(f64, Option<Trial>)> = None;
        if !fails(self, &drawn, &first) {
            if drawn.is_err() || self.hints_hold(&first) {
                return drawn;
            }
            nearest = Some((self.miss_of_hints(&first), None));
        }
        // What is searched through is limited: a group of many dyads is tried in one way only.
        let mut searched = assemblies(&first);
        let mut closed: Vec<Vec<(TrialDriver, Closing)>> = Vec::new();
        closed.extend(nearest.is_some().then(|| first.drivers.clone()));
        for trial in self.other_ways(index) {
            // What closes with the same driven and the same left open closes in the same places, whatever is known of it.
            if closed.contains(&trial.drivers) {
                continue;
            }
            searched += assemblies(&trial);
            let most = if nearest.is_some() { MOST_ASSEMBLIES } else { MOST_WHERE_NONE };
            if searched > most {
                break;
            }
            self.back_to(&before);
            let other = self.position_with(step, &trial, true);
            if fails(self, &other, &trial) {
                continue;
            }
            if nearest.is_none() && other.is_err() || other.is_ok() && self.hints_hold(&trial) {
                self.ways.insert(index, trial);
                return other;
            }
            closed.push(trial.drivers.clone());
            let miss = self.miss_of_hints(&trial);
            if other.is_ok() && nearest.as_ref().is_none_or(|(least, _)| miss < CLEARLY * least) {
                nearest = Some((miss, Some(trial)));
            }
        }
        if nearest.is_none() {
            // Places by which links stand may tell less than a trial does: where an arc about the one touches a guide.
            let mut searched = 0;
            for trial in std::iter::once(first.clone()).chain(self.other_ways(index)) {
                searched += assemblies(&trial);
                if searched > MOST_ASSEMBLIES {
                    break;
                }
                self.back_to(&before);
                let other = self.position_with(step, &trial, false);
                if other.is_ok() && !fails(self, &other, &trial) {
                    self.ways.insert(index, trial);
                    return other;
                }
            }
        }
        self.back_to(&before);
        match nearest {
            Some((_, Some(trial))) => {
                let drawn = self.position_with(step, &trial, true);
                self.ways.insert(index, trial);
                drawn
            }
            _ => self.position_with(step, &first, true),
        }
    }

    /// Squares of the distances of a group's points from their rough places, metres.
    fn misses_of_hints(&self, trial: &Trial) -> Vec<f64> {
        let stands = |point: PointId| self.miss_of_hint(point, self.places[point.0]?.value());
        self.points_of(trial).into_iter().filter_map(stands).collect()
    }

    /// By how much the points of a group miss their rough places together.
    fn miss_of_hints(&self, trial: &Trial) -> f64 {
        self.misses_of_hints(trial).iter().sum()
    }

    /// Whether no point of a group stands far from its rough place, for the size of what is drawn.
    fn hints_hold(&self, trial: &Trial) -> bool {
        let places: Vec<[f64; 2]> = self.places.iter().flatten().map(|at| at.value()).collect();
        let extent = |axis: usize| {
            let all = || places.iter().map(|at| at[axis]);
            all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
        };
        let far = FAR_FROM_HINT * libm::hypot(extent(0), extent(1)) * self.scales.length();
        self.misses_of_hints(trial).iter().all(|miss| *miss <= far * far)
    }

    /// The skeleton of the group by one way to try it; where links stand by places alone nothing is tried, if that is
    /// allowed.
    fn position_with(&mut self, step: &GroupStep, trial: &Trial, by_places: bool) -> Result<(), DrawError> {
        let steps = trial_steps(trial, step, self.mechanism);
        self.board.purpose("position by trial");
        let points = self.points_of(trial);
        let given: Vec<PointId> = points.iter().copied().filter(|&p| self.is_given(p)).collect();
        let exact = |p: &PointId| given.contains(p);
        if by_places && points.iter().any(exact) && self.stand_by_places(trial, step) {
            return Ok(());
        }
        let rod = self.on_rods(trial, &step.points);
        if trial.drivers.is_empty() {
            return self.positions(trial, &steps, &rod, &[]);
        }
        let loose = trial.drivers.iter().find_map(|&(driver, _)| self.not_placed(driver));
        // Rolling says nothing of where it began: what is tried stands as placed.
        let rolls = trial.drivers.iter().any(|&(_, closing)| !self.says_where(closing));
        if loose.is_none() {
            if points.iter().all(exact) {
                return self.positions(trial, &steps, &rod, &[]);
            }
            // What is driven is placed; only which way the groups between are assembled is open.
            let roots = self.roots_as_placed(trial);
            if !roots.is_empty() || rolls || trial.drivers.len() > 1 {
                let root = self.choose_root(trial, roots, f64::INFINITY)?;
                self.sides = Some(root.sides);
                let drawn = self.positions(trial, &steps, &rod, &[]);
                self.sides = None;
                return drawn;
            }
        }
        if rolls || trial.drivers.len() > 1 {
            let untold = |&(_, closing): &(TrialDriver, Closing)| match closing {
                Closing::Angle { input, .. } if !self.says_where(closing) => Some(input),
                _ => None,
            };
            if let Some(input) = trial.drivers.iter().find_map(untold) {
                return Err(DrawError::NoAngle { input });
            }
            let point = loose.or_else(|| points.into_iter().find(|p| !exact(p)));
            return Err(point.map_or_else(
                || DrawError::NoConstruction { links: self.links_of_trial(trial) },
                |point| DrawError::NotPlaced { point },
            ));
        }
        self.tried = self.what_moves(trial, given);
        let drawn = self.by_trial(trial, &steps, &rod);
        self.tried = Tried::default();
        drawn
    }

    /// What moves while a group is tried. A rider of placed points does not: how it is turned against its guide is told by
    /// its places alone.
    fn what_moves(&self, trial: &Trial, mut points: Vec<PointId>) -> Tried {
        let as_placed: Vec<LinkId> = self
            .mechanism
            .slides
            .iter()
            .filter_map(|slide| match slide.rider {
                Rider::Link { link, turned: None } => Some(link),
                _ => None,
            })
            .collect();
        let of_rider = |point: &PointId| {
            as_placed.iter().any(|&rider| self.mechanism.link(rider).points.contains(point))
        };
        points.retain(|point| !of_rider(point));
        let mut links = self.links_of_trial(trial);
        links.extend(closing_rods(trial));
        links.retain(|link| !as_placed.contains(link));
        Tried { points, links }
    }

    /// Whether a trial is of a group of more than two links with turning pairs and pins on guides alone, and nothing driven in
    /// it. Of others a reader may find a dyad by what is driven, rolls or slides without turning.
    fn has_no_dyad(&self, trial: &Trial) -> bool {
        let plain = |joint: &Joint| match *joint {
            Joint::Pin(..) | Joint::Trial(_) => true,
            Joint::Slide(slide) => matches!(self.mechanism.slides[slide].rider, Rider::Pin { .. }),
            Joint::Roll(_) | Joint::Contact(_) | Joint::Input(_) | Joint::TurnsWith(..) => false,
        };
        let open = |&(_, closing): &(TrialDriver, Closing)| {
            matches!(closing, Closing::Rod { .. } | Closing::Slide { .. })
        };
        let mut links = self.links_of_trial(trial);
        links.extend(closing_rods(trial));
        links.retain(|&link| !self.mechanism.link(link).block);
        links.len() > 2
            && trial.groups.iter().flat_map(|group| &group.joints).all(plain)
            && trial.drivers.iter().all(open)
    }

    fn by_trial(&mut self, trial: &Trial, steps: &[GroupStep], rod: &GroupStep) -> Result<(), DrawError> {
        let mut root = match self.searched {
            Some(searched) => searched.root(self, trial)?,
            None => self.find_root(trial)?,
        };
        let slope = self.settle_root(trial, steps, &mut root);
        let links = self.links_of_trial(trial);
        let Some(&(driver, closing)) = trial.drivers.first() else {
            return Err(DrawError::NoConstruction { links });
        };
        self.act(Act::TryPosition { driver, closing, of_no_dyad: self.has_no_dyad(trial) });
        // First with the angle found on the scratch board, then with what the tape makes of it.
        let found = self.board.found(root.angle);
        let blank = self.standing_now();
        self.silent = true;
        self.sides = Some(root.sides.clone());
        let tried = self.positions(trial, steps, rod, &[found]);
        let miss = tried.map(|()| self.miss(closing));
        self.silent = false;
        self.nothing_missing()?;
        let reason = self.reason(&links);
        let Some(miss) = miss?? else { return Err(DrawError::NoConstruction { links }) };
        let angle = self.board.corrected(found, miss, (slope, self.unit_of_trial(driver)), reason);
        self.sides = Some(root.sides);
        self.stand_as(&blank);
        let drawn = self.positions(trial, steps, rod, &[angle]);
        self.sides = None;
        drawn
    }

    /// Lays on the links of a group whose given places tell how each of them stands, one after the other; says
    /// whether they do, and leaves the skeleton as it was where they do not.
    fn stand_by_places(&mut self, trial: &Trial, step: &GroupStep) -> bool {
        let of_group = trial.groups.iter().flat_map(|group| &group.links).copied().chain(closing_rods(trial));
        let links: Vec<LinkId> = of_group.collect();
        let points = self.points_of(trial);
        if !self.lay_on_by_places(links, &points, step) {
            return false;
        }
        self.act(Act::MarkPlaces);
        let joints = trial.groups.iter().flat_map(|group| &group.joints);
        let rolls = joints.filter_map(|joint| match *joint {
            Joint::Roll(roll) | Joint::Contact(roll) => Some(roll),
            _ => None,
        });
        let open = trial.drivers.iter().filter_map(|&(_, closing)| match closing {
            Closing::Roll { roll } | Closing::Contact { roll, .. } => Some(roll),
            _ => None,
        });
        let mut rolls: Vec<usize> = rolls.chain(open).collect();
        rolls.sort_unstable();
        rolls.dedup();
        for roll in rolls {
            let [body, _] = self.mechanism.rolls[roll].bodies();
            self.contact(body, roll);
        }
        true
    }

    /// The same of these links and points; says nothing of contacts.
    pub(super) fn lay_on_by_places(
        &mut self,
        links: Vec<LinkId>,
        all_points: &[PointId],
        step: &GroupStep,
    ) -> bool {
        let mut waiting: Vec<LinkId> = links.into_iter().filter(|&l| !self.mechanism.link(l).block).collect();
        let before = (self.places.clone(), self.poses.clone());
        loop {
            let count = waiting.len();
            for link in std::mem::take(&mut waiting) {
                if !self.stands_in_world(link) && self.pose_of(link).is_none() && !self.stands_alone(link) {
                    waiting.push(link);
                    continue;
                }
                let points = self.mechanism.link(link).points.iter().map(|&p| (link, p));
                let points = points.filter(|(_, p)| self.places[p.0].is_none()).collect();
                self.transfer_by_pose(&GroupStep { group: step.group, points }, link);
            }
            if waiting.is_empty() {
                break;
            }
            if waiting.len() < count {
                continue;
            }
            let loud = !std::mem::replace(&mut self.silent, true);
            let found = self.place_by_loci(all_points);
            self.silent = !loud;
            if !matches!(found, Ok(true)) {
                (self.places, self.poses) = before;
                return false;
            }
        }
        for &point in all_points {
            if self.places[point.0].is_none() && !self.prick_given(point) {
                (self.places, self.poses) = before;
                return false;
            }
        }
        true
    }

    /// Lays on a link of one joint whose place is given, where what it turns with or towards stands; says whether it does.
    pub(super) fn stands_alone(&mut self, link: LinkId) -> bool {
        let joint = match self.mechanism.link(link) {
            Link { form: Form::Single, points, .. } => points.first().copied(),
            _ => None,
        };
        let Some(joint) = joint else { return false };
        let Some(at) = self.place_by_places(joint) else { return false };
        self.place(joint, at);
        if let Some(slide) = self.swivels_by(link) {
            let rider = self.joint_of_rider(slide);
            if rider.is_none_or(|rider| self.place_by_places(rider).is_none()) {
                return false;
            }
        } else if !self.has_axes_of_world(link) {
            // It rides on what does not stand yet.
            return false;
        }
        self.one_joint_link(link, joint).is_ok()
    }

    /// Every way in which the group closes with what is driven standing as placed.
    fn roots_as_placed(&mut self, trial: &Trial) -> Vec<Root> {
        let (steps, rod) = self.all_steps(trial);
        let choices = choices(trial);
        let mut roots: Vec<Root> = Vec::new();
        let mut sketch = self.sketch();
        let blank = sketch.standing_now();
        for combination in 0..assemblies(trial) {
            let sides: Vec<Side> = (0..choices)
                .map(|k| if combination >> k & 1 == 0 { Side::First } else { Side::Second })
                .collect();
            sketch.stand_as(&blank);
            sketch.sides = Some(sides.clone());
            if sketch.positions(trial, &steps, &rod, &[]).is_err() {
                continue;
            }
            let closes = |closing| match sketch.miss(closing) {
                Ok(Some(miss)) => miss.value().abs() < ROOT,
                Ok(None) => true,
                Err(_) => false,
            };
            if trial.drivers.iter().map(|&(_, closing)| closing).all(closes) && sketch.face_riders(trial) {
                self.add_root(trial, &mut roots, &sketch, (0.0, sides));
            }
        }
        roots
    }

    /// Whether the links of one joint that turn with their riders point towards these.
    fn face_riders(&mut self, trial: &Trial) -> bool {
        !trial.knows_turning() || self.links_of_trial(trial).into_iter().all(|link| self.faces_rider(link))
    }

    /// The steps of the group with every point.
    fn all_steps(&self, trial: &Trial) -> (Vec<GroupStep>, GroupStep) {
        let any = trial.groups.iter().find_map(|g| g.links.first()).copied().unwrap_or(LinkId::FRAME);
        let all: Vec<(LinkId, PointId)> = self.points_of(trial).into_iter().map(|p| (any, p)).collect();
        let on_rods: Vec<(LinkId, PointId)> = closing_rods(trial)
            .into_iter()
            .flat_map(|rod| self.mechanism.link(rod).points.iter().map(move |&p| (rod, p)))
            .collect();
        let rod = self.on_rods(trial, &on_rods);
        (trial_steps(trial, &GroupStep { group: 0, points: all }, self.mechanism), rod)
    }

    /// Notes a way to close the group, unless it is known.
    fn add_root(
        &self,
        trial: &Trial,
        roots: &mut Vec<Root>,
        sketch: &Draughtsman<'_>,
        (angle, sides): (f64, Vec<Side>),
    ) {
        let places = self.places_on(sketch, trial);
        let same_place = self.at_most(SAME_PLACE);
        let same = |other: &Root| {
            let pairs = other.places.iter().zip(&places);
            pairs.into_iter().all(|((_, a), (_, b))| libm::hypot(a[0] - b[0], a[1] - b[1]) < same_place)
        };
        if !roots.iter().any(same) {
            roots.push(Root { angle, sides, places });
        }
    }

    fn links_of_trial(&self, trial: &Trial) -> Vec<LinkId> {
        trial.groups.iter().flat_map(|g| g.links.clone()).collect()
    }

    /// A point that is not placed, but would have to be if what a trial moves were to stand as placed.
    fn not_placed(&self, driver: TrialDriver) -> Option<PointId> {
        let exact = |p: PointId| self.is_given(p);
        match driver {
            TrialDriver::Turn(link) => {
                let points = self.mechanism.link(link).joints();
                // Any two of its points tell how it stands; a link of one joint stands as its own coordinates say.
                let standing = points.iter().filter(|&&p| exact(p)).count();
                let told = standing >= points.len().min(2);
                points.iter().copied().find(|&p| !told && !exact(p))
            }
            TrialDriver::Slide(slide) => match self.mechanism.slides[slide].rider {
                Rider::Pin { point, .. } => (!exact(point)).then_some(point),
                Rider::Link { link, .. } => {
                    self.mechanism.link(link).points.first().copied().filter(|&p| !exact(p))
                }
            },
        }
    }

    /// Finds the places of the trial's groups, with what is driven as tried; as placed where nothing is tried.
    fn positions(
        &mut self,
        trial: &Trial,
        steps: &[GroupStep],
        rod: &GroupStep,
        tried: &[Angle],
    ) -> Result<(), DrawError> {
        let drivers = trial.drivers.iter().map(|&(driver, _)| driver);
        self.tried_places = drivers.zip(tried.iter().copied()).collect();
        let mut groups = trial.groups.iter().zip(steps);
        groups.try_for_each(|(group, step)| self.position_of(step, group))?;
        for &(_, closing) in &trial.drivers {
            match closing {
                Closing::Rod { link, near, far } => self.transfer_points(rod, &[(link, far)], near),
                Closing::Roll { roll } | Closing::Contact { roll, .. } => {
                    let [body, _] = self.mechanism.rolls[roll].bodies();
                    self.contact(body, roll);
                }
                _ => {}
            }
        }
        self.nothing_missing()
    }

    /// Whether an open constraint says something of places: rolling does not, nor does the angle of a link of one joint
    /// on which nothing slides.
    fn says_where(&self, closing: Closing) -> bool {
        match closing {
            Closing::Roll { .. } => false,
            Closing::Angle { link, input } => match self.mechanism.inputs[input] {
                _ if self.mechanism.link(link).joints().len() > 1 => true,
                Input::Angle { angle, .. } | Input::Speed { angle, .. } => {
                    angle.is_some() && self.carries_guide(link)
                }
                Input::Slide { .. } => false,
            },
            _ => true,
        }
    }

    /// By how much the open constraint is missed: paper millimetres, or radians; none where it says nothing of places.
    ///
    /// # Errors
    /// [`DrawError::Missing`] where something that it binds does not stand.
    fn miss(&mut self, closing: Closing) -> Result<Option<Mm>, DrawError> {
        if !self.says_where(closing) {
            return Ok(None);
        }
        let miss = self.miss_of_places(closing)?;
        self.nothing_missing()?;
        Ok(Some(miss))
    }

    fn miss_of_places(&mut self, closing: Closing) -> Result<Mm, DrawError> {
        Ok(match closing {
            Closing::Rod { link, near, far } => {
                let (a, b) = (self.at(near), self.at(far));
                let distance = self.board.distance(a, b);
                let length = self.length(link, far, near);
                let scale = self.length_scale();
                let mm = self.board.to_paper(length, scale);
                self.board.less(distance, mm)
            }
            Closing::Slide { slide, pin } => {
                let at = self.at(pin);
                match self.track(slide, Some(pin)) {
                    Track::Straight(line) => self.board.square_off(line, at)[1],
                    Track::Arc(arc) => {
                        let distance = self.board.distance(arc.centre, at);
                        self.board.less(distance, arc.radius)
                    }
                }
            }
            Closing::Angle { link, input } => {
                let points = self.mechanism.link(link).joints();
                let ends = (points.first().copied(), points.get(1).copied());
                let along = match ends {
                    (Some(p), Some(q)) => self.outward(link, p, q),
                    // Of a link of one joint the x-axis counts.
                    _ => {
                        let own = self.board.rightward();
                        self.carried(link, own)
                    }
                };
                let [p, q] = [ends.0, ends.1].map(|p| p.and_then(|p| self.given_place(p)));
                let angle = match self.mechanism.inputs[input] {
                    Input::Angle { angle, .. } | Input::Speed { angle, .. } => angle,
                    Input::Slide { .. } => None,
                };
                let given = match (angle, p, q) {
                    (Some(angle), ..) => {
                        let angle = self.board.input_angle(input, angle);
                        self.board.protractor(angle)
                    }
                    (None, Some(from), Some(to)) => {
                        let reason = self.reason(&[link]);
                        self.board.toward(from, to, reason).0
                    }
                    _ => self.no_direction(Missing::Input(input)),
                };
                let turn = self.board.angle_between(given, along);
                self.board.arc_length(turn)
            }
            Closing::Driven { slide, pin, input } => {
                let at = self.at(pin);
                let line = self.straight_track(slide, None);
                let [along, _] = self.board.square_off(line, at);
                // In what is tried places are hints, but this one is the input.
                let given = match (self.mechanism.inputs[input], self.world_place(pin)) {
                    (Input::Slide { at: Some(given), .. }, _) => {
                        let given = self.board.input_amount(input, given);
                        let scale = self.length_scale();
                        self.board.to_paper(given, scale)
                    }
                    (_, Some(given)) => self.board.square_off(line, given)[0],
                    _ => return Err(DrawError::Missing(Missing::Input(input))),
                };
                self.board.less(along, given)
            }
            Closing::Contact { roll, wheel, centre } => {
                let at = self.at(centre);
                let tracks = self.centre_tracks(roll, wheel);
                let mut least: Option<Mm> = None;
                for track in tracks {
                    let miss = match track {
                        Track::Straight(line) => self.board.square_off(line, at)[1],
                        Track::Arc(arc) => {
                            let distance = self.board.distance(arc.centre, at);
                            self.board.less(distance, arc.radius)
                        }
                    };
                    if least.is_none_or(|least| miss.value().abs() < least.value().abs()) {
                        least = Some(miss);
                    }
                }
                least.ok_or(DrawError::Missing(Missing::Place(centre)))?
            }
            Closing::Roll { roll } => {
                return Err(DrawError::Missing(Missing::Place(self.contact_of(roll))));
            }
        })
    }

    /// What is solved so far, as numbers.
    fn as_it_stands(&self) -> Stands {
        let numbers = |points: &[Option<Point>]| points.iter().map(|at| at.map(|at| at.value())).collect();
        let of_pose = |pose: Pose| {
            let (own, along) = (pose.own_anchor.value(), pose.own_along.value());
            [own, pose.anchor.value(), along, pose.along.value()]
        };
        Stands {
            scale: self.scales.length(),
            places: numbers(&self.places),
            pricked: numbers(&self.pricked),
            stated_hints: numbers(&self.stated_hints),
            poses: self.poses.iter().map(|pose| pose.map(of_pose)).collect(),
            tried: self.tried.clone(),
        }
    }

    /// What stands at present. What an earlier trial has left would otherwise be taken for solved by the next.
    fn standing_now(&self) -> Standing {
        Standing { places: self.places.clone(), poses: self.poses.clone() }
    }

    /// Takes off what has been drawn since.
    fn stand_as(&mut self, before: &Standing) {
        self.places.clone_from(&before.places);
        self.poses.clone_from(&before.poses);
    }

    /// A scratch board with what is solved so far.
    fn sketch(&self) -> Draughtsman<'m> {
        let mut sketch = Draughtsman::new(Board::scratch(), self.mechanism, self.structure, self.scales);
        sketch.silent = true;
        sketch.tried.clone_from(&self.tried);
        for (to, from) in sketch.places.iter_mut().zip(&self.places) {
            *to = from.map(|p| sketch.board.copied(p.value()));
        }
        // What a figure states, or given places led to, stands on scratch paper too.
        for (to, from) in sketch.pricked.iter_mut().zip(&self.pricked) {
            *to = from.map(|p| sketch.board.copied(p.value()));
        }
        for (to, from) in sketch.stated_hints.iter_mut().zip(&self.stated_hints) {
            *to = from.map(|p| sketch.board.copied(p.value()));
        }
        for (to, from) in sketch.poses.iter_mut().zip(&self.poses) {
            *to = from.map(|pose| Pose {
                own_anchor: sketch.board.copied(pose.own_anchor.value()),
                anchor: sketch.board.copied(pose.anchor.value()),
                own_along: sketch.board.copied_direction(pose.own_along.value()),
                along: sketch.board.copied_direction(pose.along.value()),
            });
        }
        sketch
    }

    /// Every way in which the group closes, then the one that the hints choose.
    fn find_root(&mut self, trial: &Trial) -> Result<Root, DrawError> {
        let Some(&(driver, closing)) = trial.drivers.first() else {
            return Err(DrawError::NoConstruction { links: self.links_of_trial(trial) });
        };
        let (steps, rod) = self.all_steps(trial);
        let choices = choices(trial);
        let reach = self.reach_of_trial(driver);
        let at_edge = AT_EDGE * self.all_lengths();
        let is_root = self.at_most(ROOT);
        let mut roots: Vec<Root> = Vec::new();
        let mut least = f64::INFINITY;
        let mut sketch = self.sketch();
        let expected = sketch.expected(driver);
        let blank = sketch.standing_now();
        for combination in 0..assemblies(trial) {
            let sides: Vec<Side> = (0..choices)
                .map(|k| if combination >> k & 1 == 0 { Side::First } else { Side::Second })
                .collect();
            let mut evaluate = |angle: f64| -> Option<f64> {
                sketch.stand_as(&blank);
                let along = sketch.board.angle(Given::exact(angle));
                sketch.sides = Some(sides.clone());
                sketch.positions(trial, &steps, &rod, &[along]).ok()?;
                let miss = sketch.miss(closing).ok()??.value();
                miss.is_finite().then_some(miss)
            };
            // One more than a whole turn: a root at its seam lies between two trials as well.
            let whole_turn = (0..=TRIALS + 1).map(|k| reach * (2.0 * f64::from(k) / f64::from(TRIALS) - 1.0));
            let mut found = Vec::new();
            for angles in [whole_turn.collect(), about(expected, reach)] {
                for run in runs(&mut evaluate, &angles) {
                    // A root at the very edge, where a group inside is at its own dead centre, is none that is passed.
                    let edges = run.edges.iter().filter(|(_, miss)| miss.abs() < at_edge);
                    found.extend(edges.map(|(angle, _)| *angle));
                    least = run.seen.iter().fold(least, |least, (_, f)| least.min(f.abs()));
                    // A root may hide where the miss only just turns back, next to the edge of what closes, and beside an
                    // angle for which a group inside runs away: all are looked into.
                    for window in run.seen.windows(3) {
                        let &[first, middle, end] = window else { continue };
                        if let Some(turn) = turning(&mut evaluate, first, middle, end) {
                            found.extend(bracketed(&mut evaluate, first, turn, is_root));
                            found.extend(bracketed(&mut evaluate, turn, end, is_root));
                        }
                    }
                    for pair in run.seen.windows(2) {
                        found.extend(bracketed(&mut evaluate, pair[0], pair[1], is_root));
                    }
                    found.extend(looked_into(&mut evaluate, &run, is_root));
                }
            }
            for angle in found {
                sketch.stand_as(&blank);
                let along = sketch.board.angle(Given::exact(angle));
                sketch.sides = Some(sides.clone());
                if sketch.positions(trial, &steps, &rod, &[along]).is_err() || !sketch.face_riders(trial) {
                    continue;
                }
                self.add_root(trial, &mut roots, &sketch, (angle, sides.clone()));
            }
        }
        self.choose_root(trial, roots, least)
    }

    /// The way in which the group closes next to that of another drawing, its groups assembled alike; none where it closes
    /// nowhere near.
    fn root_near(&mut self, trial: &Trial, other: &Root) -> Option<Root> {
        let &(driver, closing) = trial.drivers.first()?;
        let unit = self.unit_of_trial(driver);
        let (steps, rod) = self.all_steps(trial);
        let mut sketch = self.sketch();
        let blank = sketch.standing_now();
        let mut miss_at = |angle: f64| -> Option<f64> {
            sketch.stand_as(&blank);
            let along = sketch.board.angle(Given::exact(angle));
            sketch.sides = Some(other.sides.clone());
            sketch.positions(trial, &steps, &rod, &[along]).ok()?;
            Some(sketch.miss(closing).ok()??.value())
        };
        let (at, _) = found_by_trial(other.angle, unit, &mut miss_at);
        let angle = at.filter(|at| (at - other.angle).abs() <= SLIPS * unit)?;
        miss_at(angle)?;
        let stands = sketch.face_riders(trial);
        let places = self.places_on(&sketch, trial);
        stands.then(|| Root { angle, sides: other.sides.clone(), places })
    }

    /// Where a sketch has the points of a group.
    fn places_on(&self, sketch: &Draughtsman<'_>, trial: &Trial) -> Vec<(PointId, [f64; 2])> {
        let points = self.points_of(trial).into_iter();
        points.filter_map(|p| sketch.places[p.0].map(|at| (p, at.value()))).collect()
    }

    /// Where a driver is tried if it stands by its rough place, where that tells.
    fn expected(&mut self, driver: TrialDriver) -> Option<f64> {
        let angle = |[from_x, from_y]: [f64; 2], [x, y]: [f64; 2]| libm::atan2(y - from_y, x - from_x);
        match driver {
            TrialDriver::Turn(link) => {
                let &[first, second, ..] = self.mechanism.link(link).joints() else { return None };
                let [from, to] = [first, second]
                    .map(|p| self.places[p.0].map(|at| at.value()).or_else(|| self.hint_on_paper(p)));
                Some(angle(from?, to?))
            }
            TrialDriver::Slide(slide) => {
                let hint = self.hint_on_paper(self.joint_of_rider(slide)?)?;
                let track = self.track(slide, None);
                self.nothing_missing().ok()?;
                Some(match track {
                    Track::Straight(Line { through, along }) => {
                        let ([x, y], [cos, sin]) = (through.value(), along.value());
                        (hint[0] - x) * cos + (hint[1] - y) * sin
                    }
                    Track::Arc(arc) => angle(arc.centre.value(), hint),
                })
            }
        }
    }

    /// Whether a driver is tried by an angle; else by a way along its guide.
    fn turns(&self, driver: TrialDriver) -> bool {
        match driver {
            TrialDriver::Turn(_) => true,
            TrialDriver::Slide(slide) => {
                matches!(self.mechanism.slides[slide].guide.path, Path::Arc { .. })
            }
        }
    }

    /// How far a driver may go at once: a radian, or a tenth of the paper's size.
    fn unit_of_trial(&self, driver: TrialDriver) -> f64 {
        if self.turns(driver) { 1.0 } else { TENTH_OF_PAPER }
    }

    /// What is small on paper, beside a mechanism that may be small itself.
    fn at_most(&self, millimetres: f64) -> f64 {
        let of_lengths = OF_LENGTHS * self.all_lengths();
        if of_lengths > 0.0 { millimetres.min(of_lengths) } else { millimetres }
    }

    /// All given lengths, one after the other, paper millimetres.
    fn all_lengths(&self) -> f64 {
        let lengths = self.mechanism.links.iter().flat_map(|link| given_lengths(link, &|_| true));
        lengths.map(f64::abs).sum::<f64>() / self.scales.length()
    }

    /// Half of the range in which a driver is tried: half a turn, or as far along a guide as the mechanism is large.
    fn reach_of_trial(&self, driver: TrialDriver) -> f64 {
        if self.turns(driver) {
            return std::f64::consts::PI;
        }
        let lengths = self.all_lengths();
        let places = self.places.iter().flatten().map(|p| libm::hypot(p.value()[0], p.value()[1]));
        let origin = self.origin_of_space().map(|g| g.value);
        let hints = (0..self.mechanism.points.len()).filter_map(|p| self.hint_of(PointId(p)));
        let hints = hints.map(|h| libm::hypot(h[0] - origin[0], h[1] - origin[1]) / self.scales.length());
        lengths + 2.0 * places.chain(hints).fold(0.0, f64::max)
    }

    fn choose_root(&self, trial: &Trial, mut roots: Vec<Root>, least: f64) -> Result<Root, DrawError> {
        let pin = trial.drivers.first().and_then(|&(_, closing)| match closing {
            Closing::Rod { near, .. } => Some(near),
            Closing::Slide { pin, .. } | Closing::Driven { pin, .. } => Some(pin),
            Closing::Contact { centre, .. } => Some(centre),
            Closing::Angle { link, .. } => self.mechanism.link(link).points.first().copied(),
            Closing::Roll { roll } => Some(self.contact_of(roll)),
        });
        let Some(pin) = pin else {
            return Err(DrawError::NoConstruction { links: self.links_of_trial(trial) });
        };
        let origin = self.origin_of_space().map(|g| g.value);
        let world = |at: [f64; 2]| [0, 1].map(|k| origin[k] + at[k] * self.scales.length());
        // The hints of the group's joints come first; where they have none, or do not choose, those of its other
        // points.
        let joints = self.joints_of(trial);
        let score = |root: &Root, of_joints: bool| -> f64 {
            let mut sum = 0.0;
            for (point, at) in root.places.iter().filter(|(p, _)| joints.contains(p) == of_joints) {
                if let Some(hint) = self.hint_of(*point) {
                    let at = world(*at);
                    let [dx, dy] = [at[0] - hint[0], at[1] - hint[1]];
                    sum += dx * dx + dy * dy;
                }
            }
            sum
        };
        let mut left: Vec<usize> = (0..roots.len()).collect();
        for of_joints in [true, false] {
            let scores: Vec<f64> = left.iter().map(|&root| score(&roots[root], of_joints)).collect();
            let least = scores.iter().fold(f64::INFINITY, |least, s| least.min(*s));
            let per_mm = self.scales.length();
            let open = left.into_iter().zip(scores).filter(|(_, s)| !chooses(least, *s, per_mm));
            left = open.map(|(root, _)| root).collect();
        }
        let Some(&best) = left.first() else {
            return Err(DrawError::NoClosure { pin, least: least * self.scales.length() });
        };
        if let Some(&rival) = left.get(1) {
            // Name a point by which the two can be told apart.
            let pairs = roots[best].places.iter().zip(&roots[rival].places);
            let apart = pairs
                .map(|(&(point, a), &(_, b))| (libm::hypot(a[0] - b[0], a[1] - b[1]), point, a, b))
                .max_by(|x, y| x.0.total_cmp(&y.0));
            if let Some((_, pin, a, b)) = apart {
                return Err(DrawError::Ambiguous { pin, first: world(a), second: world(b) });
            }
        }
        Ok(roots.swap_remove(best))
    }

    /// Brings a root to where whoever runs the drawing elsewhere finds it, and gives how the miss changes there.
    fn settle_root(&mut self, trial: &Trial, steps: &[GroupStep], root: &mut Root) -> Given {
        let Some(&(driver, closing)) = trial.drivers.first() else { return Given::exact(0.0) };
        let mut sketch = self.sketch();
        let on_rod = GroupStep { group: 0, points: Vec::new() };
        let blank = sketch.standing_now();
        let miss_at = |angle: f64| -> Option<f64> {
            sketch.stand_as(&blank);
            let along = sketch.board.angle(Given::exact(angle));
            sketch.sides = Some(root.sides.clone());
            sketch.positions(trial, steps, &on_rod, &[along]).ok()?;
            Some(sketch.miss(closing).ok()??.value())
        };
        let (at, slope) = found_by_trial(root.angle, self.unit_of_trial(driver), miss_at);
        root.angle = at.unwrap_or(root.angle);
        // At the edge of assembly there is no slope to rely on.
        slope.unwrap_or(Given::exact(0.0))
    }

    // --- velocity ------------------------------------------------------------------------------

    fn mark(&mut self, order: Order) -> Mark {
        Mark {
            coincident: self.coincident.len(),
            parts: self.parts.len(),
            feet: self.feet.len(),
            images: self.images(order).clone(),
        }
    }

    /// Takes a trial polygon off the board.
    fn rub_out(&mut self, order: Order, mark: &Mark) {
        self.coincident.truncate(mark.coincident);
        self.parts.truncate(mark.parts);
        self.feet.truncate(mark.feet);
        self.images(order).clone_from(&mark.images);
    }

    /// One polygon with the rates that are tried at present.
    fn polygon_at(&mut self, order: Order, trial: &Trial, steps: &[GroupStep]) {
        for (group, step) in trial.groups.iter().zip(steps) {
            match order {
                Order::Acceleration => self.acceleration_of(step, group),
                _ => self.velocity_of(step, group),
            }
        }
    }

    fn try_rate(&mut self, order: Order, driver: TrialDriver, rate: Amount) {
        self.tried_rates.retain(|(of, tried, _)| (*of, *tried) != (order, driver));
        self.tried_rates.push((order, driver, rate));
    }

    /// A rate at which trial vectors have a good length on paper.
    fn trial_rate(&self, order: Order, driver: TrialDriver) -> f64 {
        let si_per_mm = self.polygon_scale(order).si_per_mm;
        let rate = match driver {
            TrialDriver::Slide(_) => TRIAL_VECTOR * si_per_mm,
            TrialDriver::Turn(link) => {
                let places =
                    self.mechanism.link(link).points.iter().filter_map(|p| Some(self.places[p.0]?.value()));
                let places: Vec<[f64; 2]> = places.collect();
                let reach = places
                    .iter()
                    .flat_map(|a| places.iter().map(move |b| libm::hypot(a[0] - b[0], a[1] - b[1])))
                    .fold(0.0, f64::max);
                TRIAL_VECTOR * si_per_mm / (reach.max(1e-3) * self.scales.length())
            }
        };
        if rate.is_normal() { rate } else { 1.0 }
    }

    /// The velocity or acceleration polygon of the group, by the first way to try it that tells something.
    pub(super) fn polygon_by_trial(&mut self, order: Order, step: &GroupStep, index: usize) {
        let (before, mark) = (self.record().clone(), self.mark(order));
        let first = self.trial(index);
        self.polygon_with(order, step, &first);
        if !self.tells_nothing(order, &first) {
            return;
        }
        let (mechanism, structure) = (self.mechanism, self.structure);
        let last = std::iter::once_with(|| structure.last_ways_to_try(mechanism, index, MOST_LAST_WAYS));
        for trial in self.other_ways(index).chain(last.flatten()) {
            self.rub_out(order, &mark);
            self.begin_again_from(&before);
            self.polygon_with(order, step, &trial);
            if !self.tells_nothing(order, &trial) {
                self.ways.insert(index, trial);
                return;
            }
        }
        self.rub_out(order, &mark);
        self.begin_again_from(&before);
        self.polygon_with(order, step, &first);
    }

    fn polygon_with(&mut self, order: Order, step: &GroupStep, trial: &Trial) {
        let steps = trial_steps(trial, step, self.mechanism);
        self.board.purpose("polygon by trial");
        // What another group, or another way, has tried is no rate of this one.
        self.tried_rates.retain(|(of, ..)| *of != order);
        for level in 0..trial.drivers.len() {
            self.find_rate(order, trial, &steps, level);
        }
        self.polygon_at(order, trial, &steps);
        for &(_, closing) in &trial.drivers {
            self.close(order, closing);
        }
        for (rod, point) in self.on_rods(trial, &step.points).points {
            for &(_, closing) in &trial.drivers {
                let Closing::Rod { link, near, far } = closing else { continue };
                if link != rod {
                    continue;
                }
                let image = match self.straight_ratio(link, far, near, point) {
                    Some(ratio) => self.divide_image(order, (far, near), point, ratio),
                    None => self.similar_image(order, link, (far, near), point),
                };
                let image = self.note_image(order, point, image);
                self.absolute_of(order, point, image);
            }
        }
    }

    /// Finds the rate of one driver, those before it being tried or found; those after it are found with each
    /// trial.
    fn find_rate(&mut self, order: Order, trial: &Trial, steps: &[GroupStep], level: usize) {
        let (driver, closing) = trial.drivers[level];
        // A first guess shows how large the rate will be; the trials that are kept have round rates on both
        // sides of it, so that the trial images lie near the true one and the polygon fills its panel.
        let loud = !std::mem::replace(&mut self.silent, true);
        let guess = self.trial_rate(order, driver);
        let rough = self.rate_by_trial(order, trial, steps, level, [0.0, guess]).0.value();
        self.silent = !loud;
        let large = rough.is_normal() && rough.abs() > LEAST_RATE * guess;
        let rates = if large { around(rough) } else { [0.0, guess] };
        self.step(order, &self.links_of_trial(trial), Vec::new());
        self.act(Act::TryPolygon { driver, closing, order, rates });
        let (rate, missed) = self.rate_by_trial(order, trial, steps, level, rates);
        self.act(Act::TrialRate { driver, order, rate: rate.value(), missed });
        self.try_rate(order, driver, rate);
    }

    /// A driver's rate, by two trial polygons with assumed rates, and by how much these miss where their images do not tell it.
    fn rate_by_trial(
        &mut self,
        order: Order,
        trial: &Trial,
        steps: &[GroupStep],
        level: usize,
        assumed: [f64; 2],
    ) -> (Amount, Option<[f64; 2]>) {
        let (driver, closing) = trial.drivers[level];
        let mark = self.mark(order);
        let rates = assumed.map(|rate| self.board.amount(Given::exact(rate)));
        let by_images = trial.drivers.len() == 1 && closes_outside(self.mechanism, trial, closing);
        let loud = !self.silent;
        let trials = rates.map(|rate| {
            self.silent = true;
            self.try_rate(order, driver, rate);
            for inner in level + 1..trial.drivers.len() {
                self.find_rate(order, trial, steps, inner);
            }
            self.polygon_at(order, trial, steps);
            let seen = match closing_unknown(closing) {
                Some((_, end)) if by_images => (Some(self.image(order, end)), None),
                _ => (None, Some(self.rate_missed(order, closing))),
            };
            self.silent = !loud;
            self.rub_out(order, &mark);
            seen
        });
        let links = self.links_of_trial(trial);
        let reason = self.reason(&links);
        match trials {
            [(Some(first), _), (Some(second), _)] => {
                (self.rate_by_images(order, closing, [first, second], rates, reason), None)
            }
            [(_, Some(first)), (_, Some(second))] => {
                let gained = self.board.difference(second, first);
                let wanted = self.board.opposite(first);
                let part = self.board.quotient(wanted, gained, reason);
                let step = self.board.difference(rates[1], rates[0]);
                let further = self.board.product(part, step);
                (self.board.sum(rates[0], further), Some([first.value(), second.value()]))
            }
            _ => (self.no_amount(Missing::rate_of(order, driver)), None),
        }
    }

    /// How far an image lies off the line on which an open constraint wants it.
    fn off_line(&mut self, order: Order, unknown: Unknown, end: PointId) -> Amount {
        let scale = self.polygon_scale(order);
        let ray = self.closing_line(order, unknown, end);
        let image = self.image(order, end);
        let [_, across] = self.board.square_off(ray, image);
        self.board.read(across, scale)
    }

    /// By how much a trial polygon does not satisfy an open constraint.
    fn rate_missed(&mut self, order: Order, closing: Closing) -> Amount {
        let scale = self.polygon_scale(order);
        let (has, given) = match closing {
            Closing::Angle { link, input } => (self.rate(order, link), self.given_rate(order, input)),
            Closing::Driven { slide, pin, input } => {
                let ray = self.closing_line(order, Unknown::Slide { slide, back: false }, pin);
                let image = self.image(order, pin);
                let [along, _] = self.board.square_off(ray, image);
                let has = self.board.read(along, scale);
                (has, self.driven_rate(order, Drive::Input(input)))
            }
            Closing::Roll { roll } => return self.slip_at_contact(order, roll),
            Closing::Rod { link, near, far } => {
                return self.off_line(order, Unknown::Turn { link, base: far, to: near }, near);
            }
            Closing::Slide { slide, pin } => {
                return self.off_line(order, Unknown::Slide { slide, back: false }, pin);
            }
            Closing::Contact { roll, wheel, centre } => {
                return self.off_line(order, Unknown::Roll { roll, wheel, centre, back: false }, centre);
            }
        };
        self.board.difference(has, given)
    }

    /// The rate by which the open end's image falls on the line of the open constraint.
    fn rate_by_images(
        &mut self,
        order: Order,
        closing: Closing,
        [first, second]: [Point; 2],
        rates: [Amount; 2],
        reason: crate::board::Reason,
    ) -> Amount {
        let Some((unknown, end)) = closing_unknown(closing) else { return rates[0] };
        let loud = !self.silent;
        self.silent = true;
        let ray = self.closing_line(order, unknown, end);
        self.silent = !loud;
        let (along, whole) = self.board.toward(first, second, reason);
        let meet = self.board.meet_lines(Line { through: first, along }, ray, reason);
        for (at, second) in [(first, false), (second, true)] {
            self.note_foot(order, Label::Trial { point: end, second }, at);
        }
        self.note_trial_line(order, first, second);
        self.note_trial_line(order, first, meet.at);
        let part = self.board.ratio(meet.along[0], whole, reason);
        let step = self.board.difference(rates[1], rates[0]);
        let further = self.board.part_of(step, part);
        self.board.sum(rates[0], further)
    }

    /// How fast two bodies slip on each other at their contact: that part of the difference of the contact
    /// points' images which is square to the common normal.
    fn slip_at_contact(&mut self, order: Order, roll: usize) -> Amount {
        let [first, second] = self.mechanism.rolls[roll].bodies();
        let [from, to] = [first, second].map(|body| self.contact_image(order, roll, body));
        let normal = self.common_normal(roll).0;
        let [_, across] = self.board.square_off(Line { through: from, along: normal }, to);
        let scale = self.polygon_scale(order);
        self.board.read(across, scale)
    }

    /// Shows in the true polygon that the contact points of both bodies have one velocity, or accelerations that
    /// differ along the common normal.
    fn show_contact(&mut self, order: Order, roll: usize) {
        let [first, second] = self.mechanism.rolls[roll].bodies();
        self.step(order, &[first, second], Vec::new());
        let images = [first, second]
            .map(|body| (self.contact_label(roll, body), self.contact_image(order, roll, body)));
        if order == Order::Acceleration {
            let claim = self.common_normal(roll).1;
            self.note_ray(order, images[0].1, images[1].1, claim);
            self.read_contact_normal((roll, first), claim, images[0], images[1]);
        } else {
            self.act(Act::SameImage { label: images[0].0, with: images[1].0 });
        }
    }

    /// Reads what the open constraint has become in the true polygon: ω or ε of the closing rod, the sliding.
    fn close(&mut self, order: Order, closing: Closing) {
        if let Closing::Roll { roll } = closing {
            self.show_contact(order, roll);
        }
        let Some((unknown, end)) = closing_unknown(closing) else { return };
        let links: Vec<LinkId> = match closing {
            Closing::Rod { link, .. } => vec![link],
            _ => Vec::new(),
        };
        self.step(order, &links, Vec::new());
        let image = self.image(order, end);
        let head = (self.label(end), image);
        self.read_closing(order, unknown, Target::Pin(end), head);
        if let Closing::Slide { slide, .. } = closing
            && let Rider::Pin { block: Some(block), .. } = self.mechanism.slides[slide].rider
        {
            self.rates_of_blocks(order, &[block]);
        }
    }
}

/// Two round numbers of the sign of a value, one on each side of it and neither at it.
fn around(value: f64) -> [f64; 2] {
    const ROUND: [f64; 9] = [0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0];
    /// A trial that happens to be the answer shows nothing.
    const APART: f64 = 0.05;
    let size = value.abs();
    let power = libm::pow(10.0, libm::floor(libm::log10(size)));
    let part = size / power;
    let below = ROUND.into_iter().rev().find(|round| *round <= part * (1.0 - APART));
    let above = ROUND.into_iter().find(|round| *round >= part * (1.0 + APART));
    [below.unwrap_or(ROUND[0]), above.unwrap_or(ROUND[8])].map(|round| round * power * value.signum())
}

/// How many of a trial's groups may close in two ways.
fn choices(trial: &Trial) -> usize {
    let twice = |group: &&Group| {
        matches!(
            group.kind,
            GroupKind::Rrr { .. }
                | GroupKind::Rrp { .. }
                | GroupKind::Rpr { .. }
                | GroupKind::Prp { .. }
                | GroupKind::Rpp { .. }
                | GroupKind::Yoke { .. }
                | GroupKind::DrivenBar { .. }
                | GroupKind::Driven { .. }
                | GroupKind::Rolling { .. }
        )
    };
    trial.groups.iter().filter(twice).count()
}

/// In how many ways the groups of a trial may be assembled, so far as they are looked through.
fn assemblies(trial: &Trial) -> usize {
    1 << choices(trial).min(6)
}

/// The rods that a trial leaves open.
fn closing_rods(trial: &Trial) -> Vec<LinkId> {
    let rod = |&(_, closing): &(TrialDriver, Closing)| match closing {
        Closing::Rod { link, .. } => Some(link),
        _ => None,
    };
    trial.drivers.iter().filter_map(rod).collect()
}

/// The route along which an open constraint leads to its end; none where the end is no image.
fn closing_unknown(closing: Closing) -> Option<(Unknown, PointId)> {
    match closing {
        Closing::Rod { link, near, far } => Some((Unknown::Turn { link, base: far, to: near }, near)),
        Closing::Slide { slide, pin } => Some((Unknown::Slide { slide, back: false }, pin)),
        Closing::Contact { roll, wheel, centre } => {
            Some((Unknown::Roll { roll, wheel, centre, back: false }, centre))
        }
        Closing::Angle { .. } | Closing::Driven { .. } | Closing::Roll { .. } => None,
    }
}

/// Whether the line of an open constraint is the same in every trial: it runs from what is solved before the group.
fn closes_outside(mechanism: &Mechanism, trial: &Trial, closing: Closing) -> bool {
    let inside = |link: LinkId| trial.groups.iter().any(|group| group.links.contains(&link));
    let found = |point: PointId| {
        trial.groups.iter().any(|group| group.points.contains(&point))
            || mechanism.point(point).links.iter().any(|&link| inside(link))
    };
    match closing {
        Closing::Rod { far, .. } => !found(far),
        Closing::Slide { slide, pin } => !inside(mechanism.slides[slide].guide.link) && found(pin),
        _ => false,
    }
}

/// Trials about an expected one, ever closer: there the range in which a group closes may be shorter than a step of the whole.
fn about(expected: Option<f64>, reach: f64) -> Vec<f64> {
    let Some(expected) = expected else { return Vec::new() };
    let away = |k: i32| libm::ldexp(reach, -k);
    let below = (FARTHEST..=CLOSEST).map(|k| expected - away(k));
    let above = (FARTHEST..=CLOSEST).rev().map(|k| expected + away(k));
    below.chain([expected]).chain(above).collect()
}

/// Trials one after the other, for all of which the group closes, with the misses.
#[derive(Debug, Default, PartialEq)]
struct Run {
    seen: Vec<(f64, f64)>,
    /// Which of them are edges of what closes.
    edges: Vec<(f64, f64)>,
}

/// Trials at these angles, by the ranges in which the group closes.
fn runs(evaluate: &mut impl FnMut(f64) -> Option<f64>, angles: &[f64]) -> Vec<Run> {
    let mut all = Vec::new();
    let mut run = Run::default();
    let mut before: Option<(f64, bool)> = None;
    for &here in angles {
        let now = evaluate(here);
        let edge = match before {
            Some((last, false)) if now.is_some() => edge(evaluate, last, here),
            Some((last, true)) if now.is_none() => edge(evaluate, here, last),
            _ => None,
        };
        run.seen.extend(edge);
        run.edges.extend(edge);
        run.seen.extend(now.map(|miss| (here, miss)));
        if now.is_none() && !run.seen.is_empty() {
            all.push(std::mem::take(&mut run));
        }
        before = Some((here, now.is_some()));
    }
    if !run.seen.is_empty() {
        all.push(run);
    }
    all
}

/// Roots that hide between two trials of a run: of two next to each other, of one next to an angle for which a group inside
/// runs away, and of those next to an edge, where a miss goes with the root of what is left.
fn looked_into(evaluate: &mut impl FnMut(f64) -> Option<f64>, run: &Run, is_root: f64) -> Vec<f64> {
    let mut closer = Closer { evaluate, is_root, left: MOST_CLOSER, found: Vec::new() };
    let at = |index: Option<usize>| index.and_then(|index| run.seen.get(index).copied());
    for index in 0..run.seen.len().saturating_sub(1) {
        let pair = [run.seen[index], run.seen[index + 1]];
        closer.look([at(index.checked_sub(1)), at(Some(index + 2))], pair, 0);
    }
    closer.found
}

/// Looks closer where a miss may pass zero unseen.
struct Closer<'e, E> {
    evaluate: &'e mut E,
    is_root: f64,
    /// Trials that may still be made.
    left: usize,
    found: Vec<f64>,
}

impl<E: FnMut(f64) -> Option<f64>> Closer<'_, E> {
    /// By how much a miss is beside the straight line between its neighbours.
    fn bend([a, b, c]: [(f64, f64); 3]) -> f64 {
        (b.1 - a.1 - (c.1 - a.1) * (b.0 - a.0) / (c.0 - a.0)).abs()
    }

    /// Whether the miss may pass zero between two trials besides where its signs tell: it bends by as much as it would have
    /// to. A parabola that bends by b over two steps is, between two trials at which it is larger than b / 4, nowhere zero.
    fn may_hide(&self, [before, after]: [Option<(f64, f64)>; 2], [a, b]: [(f64, f64); 2]) -> bool {
        /// As much more than a parabola bends.
        const AT_LEAST: f64 = 2.0;
        let bends = [before.map(|before| Self::bend([before, a, b])), after.map(|c| Self::bend([a, b, c]))];
        let bend = bends.into_iter().flatten().fold(0.0_f64, f64::max);
        let apart = if (a.1 <= 0.0) == (b.1 <= 0.0) { a.1.abs().min(b.1.abs()) } else { (b.1 - a.1).abs() };
        bend > self.is_root * NO_BEND && apart <= AT_LEAST * bend
    }

    fn look(&mut self, beside: [Option<(f64, f64)>; 2], pair: [(f64, f64); 2], deep: usize) {
        /// Into so many parts.
        const PARTS: u32 = 4;
        let [a, b] = pair;
        if deep == DEEPEST_LOOK || self.left == 0 || !self.may_hide(beside, pair) {
            if deep > 0 {
                self.found.extend(bracketed(self.evaluate, a, b, self.is_root));
            }
            return;
        }
        self.left = self.left.saturating_sub(PARTS as usize - 1);
        let between = (0..=PARTS).map(|k| a.0 + (b.0 - a.0) * f64::from(k) / f64::from(PARTS));
        let angles: Vec<f64> = between.collect();
        for run in runs(self.evaluate, &angles) {
            let seen = &run.seen;
            for index in 0..seen.len().saturating_sub(1) {
                let before = match index.checked_sub(1) {
                    Some(before) => seen.get(before).copied(),
                    None => beside[0].filter(|_| seen[0].0 == a.0),
                };
                let after = seen.get(index + 2).copied().or(beside[1].filter(|_| seen[index + 1].0 == b.0));
                self.look([before, after], [seen[index], seen[index + 1]], deep + 1);
            }
        }
    }
}

/// The outermost angle at which the group still closes, between one where it does not and one where it
/// does, with the miss there.
fn edge(
    evaluate: &mut impl FnMut(f64) -> Option<f64>,
    mut outside: f64,
    mut inside: f64,
) -> Option<(f64, f64)> {
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(outside, inside);
        if evaluate(middle).is_some() { inside = middle } else { outside = middle }
    }
    evaluate(inside).map(|f| (inside, f))
}

/// Where a miss that does not change its sign comes nearest to zero between three trials, if it passes
/// zero there.
fn turning(
    evaluate: &mut impl FnMut(f64) -> Option<f64>,
    first: (f64, f64),
    middle: (f64, f64),
    end: (f64, f64),
) -> Option<(f64, f64)> {
    /// Thirds of the interval that are cut off until the turning point is known well enough.
    const CUTS: usize = 40;
    let sign = first.1 > 0.0;
    let one_sided = [middle, end].iter().all(|(_, f)| (*f > 0.0) == sign);
    if !one_sided || middle.1.abs() > first.1.abs() || middle.1.abs() > end.1.abs() {
        return None;
    }
    let (mut low, mut high) = (first.0, end.0);
    for _ in 0..CUTS {
        let (a, b) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
        let (fa, fb) = (evaluate(a)?, evaluate(b)?);
        for (angle, f) in [(a, fa), (b, fb)] {
            if (f > 0.0) != sign {
                return Some((angle, f));
            }
        }
        if fa.abs() < fb.abs() { high = b } else { low = a }
    }
    None
}

/// The root in a bracket, if there is one.
fn bracketed(
    evaluate: &mut impl FnMut(f64) -> Option<f64>,
    low: (f64, f64),
    high: (f64, f64),
    is_root: f64,
) -> Option<f64> {
    if (low.1 <= 0.0) == (high.1 <= 0.0) {
        return None;
    }
    halve(evaluate, low.0, high.0, (low.1, is_root))
}

/// Halves a bracket down to rounding; `None` where the function jumps instead of passing zero.
fn halve(
    evaluate: &mut impl FnMut(f64) -> Option<f64>,
    mut low: f64,
    mut high: f64,
    (at_low, is_root): (f64, f64),
) -> Option<f64> {
    let negative = at_low <= 0.0;
    let mut last = f64::INFINITY;
    for _ in 0..HALVINGS {
        let middle = f64::midpoint(low, high);
        let value = evaluate(middle)?;
        last = value.abs();
        if (value <= 0.0) == negative { low = middle } else { high = middle }
    }
    (last < is_root).then(|| f64::midpoint(low, high))
}

#[cfg(test)]
mod tests {
    use super::{around, looked_into, runs};

    /// The roots that trials at a tenth from each other lead to, and those that hide between them.
    fn roots(mut miss: impl FnMut(f64) -> Option<f64>) -> Vec<f64> {
        let angles: Vec<f64> = (0..=10).map(|k| f64::from(k) / 10.0).collect();
        let mut all = Vec::new();
        for run in runs(&mut miss, &angles) {
            all.extend(looked_into(&mut miss, &run, 1e-6));
        }
        all.sort_by(f64::total_cmp);
        all
    }

    fn are(found: &[f64], roots: &[f64]) -> bool {
        found.len() == roots.len() && found.iter().zip(roots).all(|(a, b)| (a - b).abs() < 1e-9)
    }

    #[test]
    fn roots_between_two_trials_are_looked_for() {
        // Two next to the edge of what closes, where a miss goes with the root of what is left.
        let edge = |x: f64| (x >= 0.03).then(|| (x - 0.03).sqrt()).map(|s| (s - 0.1) * (s - 0.2));
        let found = roots(edge);
        assert!(are(&found, &[0.04, 0.07]), "{found:?}");
        // One beside an angle for which a group inside runs away: the miss has one sign on both sides of the two.
        let away = |x: f64| Some((x - 0.51) / (x - 0.52));
        let found = roots(away);
        assert!(are(&found, &[0.51]), "{found:?}");
        // Two close together, where the miss only just turns back.
        let turns = |x: f64| Some((x - 0.52) * (x - 0.53));
        let found = roots(turns);
        assert!(are(&found, &[0.52, 0.53]), "{found:?}");
        // None where the miss is straight, or only jumps.
        assert_eq!(roots(|x| Some(x + 0.1)), [0.0; 0]);
        assert_eq!(roots(|x| Some(1.0 / (x - 0.52))), [0.0; 0]);
        assert_eq!(roots(|x| Some(if x < 0.55 { -1.0 } else { 1.0 })), [0.0; 0]);
    }

    #[test]
    fn trial_rates_are_round_and_enclose_the_value() {
        for (value, trials) in [
            (2.17, [2.0, 3.0]),
            (85.8, [70.0, 100.0]),
            (-12.9, [-10.0, -15.0]),
            (1.0, [0.7, 1.5]),
            (9.9, [7.0, 15.0]),
            (0.003, [0.002, 0.005]),
        ] {
            let found = around(value);
            for (found, trial) in found.into_iter().zip(trials) {
                assert!((found / trial - 1.0).abs() < 1e-12, "{value}: {found}");
            }
        }
    }
}
