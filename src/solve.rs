//! From a scene to its checked solution: the whole way in one call.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};

use crate::analytic::{self, AnalyticError, State};
pub use crate::board::{Arithmetic, Hand};
use crate::graphical::construction::{Act, Calculation, Construction, Reading};
use crate::graphical::cycle::OwnTorque;
use crate::graphical::{self, Draughtsmen, DrawError, Extents, HandError, Scales, Solution};
use crate::mechanism::cycle::{Cycle, CycleQuantity, Sides};
use crate::mechanism::force::{Force, Heaviness, LoadKind, Share, Size};
use crate::mechanism::quantity::{
    Answer, Asked, Indeterminate, Method, Nature, Order, Quantity, Stuck, Unit,
};
use crate::mechanism::structure::{Structure, StructureError};
use crate::mechanism::{LinkId, Mechanism};
use crate::plan::{Auxiliary, CentreSource, Extent, Plan};
use crate::scene::{Refusal, Scene};
pub use crate::sweep::governor::Governed;
use crate::sweep::{self, PositionError};

/// How to solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Settings {
    /// The arithmetic of the board.
    pub arithmetic: Arithmetic,
    /// Figures are drawn even where the independent solver does not confirm them, with a note that says so.
    pub unchecked: bool,
}

/// A scene taken apart, planned and drawn.
#[derive(Debug, Clone)]
pub struct Solved {
    /// The mechanism's mobility and groups.
    pub structure: Structure,
    /// The steps that were needed.
    pub plan: Plan,
    /// The scales of the page; where only numbers were asked for, those of the board.
    pub scales: Scales,
    /// The graphical solution.
    pub solution: Solution,
    /// What the skeleton does not show, because nothing asked needs it and it cannot be drawn.
    pub left_out: Option<LeftOut>,
}

/// Links that a skeleton does not show.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Their numbers, ascending.
    pub links: Vec<u32>,
    /// Why the first of them cannot be drawn.
    pub why: DrawError,
    /// The groups that cannot be drawn, by index; what depends on them is not among them.
    groups: BTreeSet<usize>,
}

/// Why a scene has no solution.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SolveError {
    /// The freedoms do not match the inputs.
    #[error(transparent)]
    Structure(#[from] StructureError),
    /// The skeleton cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// Another position that the sheet is to show cannot be drawn.
    #[error(transparent)]
    Position(#[from] PositionError),
    /// Nothing that was asked has a meaning here, or a construction.
    #[error("{name}: {why}")]
    Unanswered {
        /// The first asked quantity.
        name: String,
        /// Why there is no answer.
        why: Indeterminate,
    },
    /// With friction no balance exists, or more than one, or a pair that rubs does not move.
    #[error("{why}")]
    Stuck {
        /// Which of them.
        how: Stuck,
        /// The pairs that rub, and when they lock.
        why: String,
    },
    /// Nothing that was asked is determined at this position.
    #[error("{}", refused(.why))]
    Indeterminate {
        /// The first asked quantity.
        name: String,
        /// Why it is not determined.
        why: Indeterminate,
    },
}

fn refused(why: &Indeterminate) -> String {
    match why {
        Indeterminate::NoEquilibrium { why } => {
            format!("no equilibrium here: {}", why.strip_prefix("no equilibrium: ").unwrap_or(why))
        }
        _ => format!("indeterminate here: {why}"),
    }
}

impl SolveError {
    /// The refusal that a scene may expect, where this is one.
    #[must_use]
    pub fn refusal(&self) -> Option<Refusal> {
        match self {
            Self::Draw(
                DrawError::CannotAssemble { .. }
                | DrawError::NoClosure { .. }
                | DrawError::Unplaced { .. }
                | DrawError::TurnedRound { .. },
            ) => Some(Refusal::CannotAssemble),
            Self::Draw(
                DrawError::Ambiguous { .. } | DrawError::NotPlaced { .. } | DrawError::NoAngle { .. },
            ) => Some(Refusal::Ambiguous),
            Self::Stuck { how: Stuck::Locked, .. }
            | Self::Indeterminate { why: Indeterminate::Rubbing { how: Stuck::Locked, .. }, .. } => {
                Some(Refusal::Locked)
            }
            Self::Stuck { how: Stuck::Ambiguous, .. } => Some(Refusal::Ambiguous),
            Self::Indeterminate { why: Indeterminate::NoEquilibrium { .. }, .. } => {
                Some(Refusal::NoEquilibrium)
            }
            Self::Stuck { how: Stuck::AtRest, .. } | Self::Unanswered { .. } | Self::Indeterminate { .. } => {
                Some(Refusal::Indeterminate)
            }
            Self::Structure(_)
            | Self::Position(_)
            | Self::Draw(
                DrawError::NoConstruction { .. } | DrawError::Missing(_) | DrawError::ComesApart { .. },
            ) => None,
        }
    }
}

/// Draws the solution of a scene, at the scales that it states or that `choose` finds for the size of its
/// diagrams, in double precision.
///
/// # Errors
/// See [`SolveError`].
pub fn solve(
    scene: &Scene,
    extent: Extent,
    choose: impl Fn(&Scene, Extents) -> Scales,
) -> Result<Solved, SolveError> {
    solve_with(scene, extent, &[], Settings::default(), choose)
}

/// The asked numbers and nothing for a page: the same doubles as any sheet has, since numbers depend on no scale.
///
/// # Errors
/// See [`SolveError`].
pub fn solve_numbers(scene: &Scene, settings: Settings) -> Result<Solved, SolveError> {
    solve_on(None, scene, Extent::Asked, &[], settings)
}

/// As [`solve`], with constructions on the skeleton besides those by which a quantity is asked, and with
/// settings of choice.
///
/// # Errors
/// See [`SolveError`].
pub fn solve_with(
    scene: &Scene,
    extent: Extent,
    auxiliary: &[Auxiliary],
    settings: Settings,
    choose: impl Fn(&Scene, Extents) -> Scales,
) -> Result<Solved, SolveError> {
    solve_on(Some(&choose), scene, extent, auxiliary, settings)
}

/// How the scales of a page are chosen for a scene whose diagrams are so large.
type Page<'a> = &'a dyn Fn(&Scene, Extents) -> Scales;

/// Solves for a page, or without one for numbers.
fn solve_on(
    page: Option<Page<'_>>,
    scene: &Scene,
    extent: Extent,
    auxiliary: &[Auxiliary],
    settings: Settings,
) -> Result<Solved, SolveError> {
    let structure = Structure::of(&scene.mechanism)?;
    // Other positions are for figures.
    let (inputs, assembly): (&[f64], bool) = match extent {
        Extent::Asked => (&[], false),
        _ => (&scene.sheet.positions, scene.sheet.other_assembly),
    };
    let others = sweep::other_positions(&scene.mechanism, inputs, assembly)?;
    let scales_for = page.map(|choose| {
        let others = &others;
        move |extents: Extents| choose(scene, extents.with(others))
    });
    let scales_for = scales_for.as_ref().map(|choose| choose as &dyn Fn(Extents) -> Scales);
    let draw = |plan: &Plan| {
        graphical::solution(settings.arithmetic, &scene.mechanism, &structure, (plan, extent), scales_for)
    };
    let plan_from = |source, left_out: &BTreeSet<usize>| {
        Plan::leaving_out(&scene.mechanism, &structure, extent, source, auxiliary, left_out)
    };
    let mut plan = plan_from(CentreSource::Diagram, &BTreeSet::new());
    let mut left_out = None;
    let (mut scales, mut solution) = match draw(&plan) {
        Err(error) if extent != Extent::Asked => {
            let left = without_the_impossible(scene, &structure, &mut plan, error, &plan_from)?;
            left_out = Some(left);
            draw(&plan)?
        }
        drawn => drawn?,
    };
    if solution.construction.circle.as_ref().is_some_and(|circle| !circle.stalled.is_empty()) {
        let without = left_out.as_ref().map_or_else(BTreeSet::new, |left: &LeftOut| left.groups.clone());
        plan = plan_from(CentreSource::Velocities, &without);
        (scales, solution) = draw(&plan)?;
    }
    let exactly = |exact: &Mechanism| {
        graphical::solution(settings.arithmetic, exact, &structure, (&plan, extent), None)
    };
    open_by_room(&scene.mechanism, &mut solution, exactly);
    unknown_places(&scene.mechanism, &mut solution);
    unclear_motion(&scene.mechanism, &mut solution);
    unstuck(scene, &structure, &plan, &solution.construction.answers)?;
    turn(scene, settings, &mut solution);
    determined(&scene.mechanism.asked, &solution.construction.answers)?;
    solution.construction.others = others;
    Ok(Solved { structure, plan, scales, solution, left_out })
}

/// Says of what is no dead centre where places stand as they are stated, and may be one within their rooms, that the rooms
/// leave it open.
fn open_by_room(
    mechanism: &Mechanism,
    solution: &mut Solution,
    exactly: impl Fn(&Mechanism) -> Result<(Scales, Solution), DrawError>,
) {
    let dead =
        |reading: &Reading| matches!(reading.answer, Answer::Indeterminate(Indeterminate::DeadCentre { .. }));
    let roomy = mechanism.roomy();
    if roomy.is_empty() || !solution.construction.answers.iter().any(dead) {
        return;
    }
    // Places that contradict each other within their rooms cannot be drawn without: there the rooms leave everything open.
    let exact = exactly(&mechanism.without_rooms()).ok().map(|(_, exact)| exact.construction.answers);
    let points: Vec<String> = roomy.into_iter().map(|point| mechanism.point(point).name.clone()).collect();
    for (index, reading) in solution.construction.answers.iter_mut().enumerate() {
        let open = |exact: &Vec<Reading>| {
            exact.get(index).is_some_and(|exact| matches!(exact.answer, Answer::Indeterminate(_)))
        };
        if dead(reading) && !exact.as_ref().is_some_and(open) {
            reading.answer = Answer::Indeterminate(Indeterminate::Room { points: points.clone() });
        }
    }
}

/// A place that is known no better than within the mechanism's size is none: told as zero it would be the origin.
fn unknown_places(mechanism: &Mechanism, solution: &mut Solution) {
    let size = solution.construction.space.size();
    for (asked, reading) in mechanism.asked.iter().zip(&mut solution.construction.answers) {
        let (Answer::Scalar { bound, .. } | Answer::Vector { bound, .. }) = reading.answer else { continue };
        let unknown = reading.answer.may_be_zero() && size > 0.0 && bound > size;
        if unknown && matches!(asked.quantity, Quantity::Position(_) | Quantity::Centre(..)) {
            let why = "the digits of the scene's numbers do not tell where it lies";
            reading.answer = Answer::Indeterminate(Indeterminate::Undefined { why: why.to_owned() });
        }
    }
}

/// A velocity or an acceleration whose bound leaves no three digits certain is none: next to a dead centre rounding grows
/// without limit, and what lies below its bound would be told as zero. Against the rest of its polygon small ones may be
/// known less well. Rooms that the scene states are its own to say. So are forces of which not even the size is known.
fn unclear_motion(mechanism: &Mechanism, solution: &mut Solution) {
    let construction = &solution.construction;
    if construction.rooms {
        return;
    }
    let acts = || construction.steps.iter().flat_map(|step| &step.acts);
    // Where nothing is accelerated the polygon is rounding: V² / l of the fastest point and the whole skeleton counts as well.
    let longest = |order: Order| match order {
        Order::Acceleration => {
            let speed = construction.longest(Order::Velocity);
            construction.longest(order).max(speed * speed / construction.space.size())
        }
        _ => construction.longest(order),
    };
    // A rate is as large as the longest vector makes it over the length by which it is divided.
    let rate = |order: Order, of: LinkId| {
        acts().find_map(|act| match (order, act) {
            (Order::Velocity, Act::Calculate(Calculation::Omega { link, length, .. }))
            | (Order::Acceleration, Act::Calculate(Calculation::Alpha { link, length, .. }))
                if *link == of =>
            {
                Some(longest(order) / length)
            }
            _ => None,
        })
    };
    let of_both = |order: Order, links: [LinkId; 2]| {
        links.into_iter().filter_map(|of| rate(order, of)).reduce(f64::max)
    };
    let compared_to = |quantity: &Quantity| match *quantity {
        Quantity::Omega(of) => rate(Order::Velocity, of),
        Quantity::Alpha(of) => rate(Order::Acceleration, of),
        Quantity::RelativeOmega(i, j) => of_both(Order::Velocity, [i, j]),
        Quantity::RelativeAlpha(i, j) => of_both(Order::Acceleration, [i, j]),
        Quantity::Ratio(..) | Quantity::Advantage(..) => Some(1.0),
        Quantity::Rub(own, ..) => acts().find_map(|act| match act {
            Act::Calculate(Calculation::Rub { pin, radius, first, second, .. }) if *pin == own => {
                Some(radius * first.abs().max(second.abs()))
            }
            _ => None,
        }),
        _ if quantity.nature() != Nature::Vector => None,
        _ => match quantity.order() {
            order @ (Order::Velocity | Order::Acceleration) => Some(longest(order)),
            _ => None,
        },
    };
    let is_unclear = |(asked, reading): (&Asked, &Reading)| {
        let (size, bound) = match reading.answer {
            Answer::Scalar { value, bound } => (value.abs(), bound),
            Answer::Vector { value: [x, y], bound } => (libm::hypot(x, y), bound),
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return false,
        };
        // The cheaper question first: nearly all are clear.
        bound > CERTAIN * size
            && compared_to(&asked.quantity).is_some_and(|to| to > 0.0 && bound > CERTAIN * SMALL * to)
    };
    // Of forces what would be told as zero though what acts is no more than what its bound leaves open. With friction a bound has
    // what a force of no direction leaves open, and says nothing of a dead centre.
    let forces = match mechanism.forces.friction.is_empty() {
        true => what_acts(mechanism, construction),
        false => [0.0; 2],
    };
    let is_lost = |(asked, reading): (&Asked, &Reading)| {
        let acts = match asked.quantity {
            Quantity::Force(of, _) => forces[usize::from(is_torque(of)?)],
            _ => return None,
        };
        let (Answer::Scalar { bound, .. } | Answer::Vector { bound, .. }) = reading.answer else {
            return None;
        };
        (reading.zero && acts > 0.0 && bound > CERTAIN * SMALL * acts).then_some(())
    };
    let unclear: Vec<bool> = mechanism
        .asked
        .iter()
        .zip(&construction.answers)
        .map(|both| is_unclear(both) || is_lost(both).is_some())
        .collect();
    for (reading, unclear) in solution.construction.answers.iter_mut().zip(unclear) {
        if unclear {
            reading.answer = Answer::Indeterminate(Indeterminate::Unclear);
        }
    }
}

/// Whether a quantity of forces is a torque, not a force; none of what is neither.
fn is_torque(of: Force) -> Option<bool> {
    match of {
        Force::Vector(_) | Force::Along { .. } | Force::Across { .. } | Force::Drive(_) | Force::Pull(_) => {
            Some(false)
        }
        Force::Torque(_) | Force::LoadTorque(_) | Force::Twist(_) | Force::Moment(..) => Some(true),
        Force::Spin | Force::InertiaTorque(_) | Force::Offset(_) | Force::Arm(..) => None,
    }
}

/// How large what acts is: the largest force that is given, or that was found with certain digits, and the largest torque.
fn what_acts(mechanism: &Mechanism, construction: &Construction) -> [f64; 2] {
    let given = &mechanism.forces;
    let mut most = [0.0_f64; 2];
    let mut note = |is_torque: bool, size: f64| {
        let own = &mut most[usize::from(is_torque)];
        *own = own.max(size.abs());
    };
    for load in &given.loads {
        match load.kind {
            LoadKind::Force { size: Size::Given(size), .. } => note(false, size.value),
            LoadKind::Vector { parts: [x, y], .. } => note(false, libm::hypot(x.value, y.value)),
            LoadKind::Torque { size: Size::Given(size), .. } => note(true, size.value),
            LoadKind::Force { .. } | LoadKind::Torque { .. } => {}
        }
    }
    let fastest = construction.longest(Order::Acceleration);
    for mass in &given.masses {
        let g = given.gravity.g.value;
        let [kilograms, weight] = match mass.heaviness {
            Heaviness::Mass(mass) => [mass.value, mass.value * g],
            Heaviness::Weight(weight) => [weight.value / g, weight.value],
            Heaviness::None => [0.0; 2],
        };
        note(false, kilograms * fastest);
        if given.gravity.acts {
            note(false, weight);
        }
    }
    for (asked, reading) in mechanism.asked.iter().zip(&construction.answers) {
        let Quantity::Force(of, _) = asked.quantity else { continue };
        let (size, bound) = match reading.answer {
            Answer::Scalar { value, bound } => (value.abs(), bound),
            Answer::Vector { value: [x, y], bound } => (libm::hypot(x, y), bound),
            Answer::AtInfinity { .. } | Answer::Indeterminate(_) => continue,
        };
        if let Some(is_torque) = is_torque(of).filter(|_| bound <= CERTAIN * size) {
            note(is_torque, size);
        }
    }
    let [force, torque] = most;
    let size = construction.space.size();
    [if size > 0.0 { force.max(torque / size) } else { force }, torque.max(force * size)]
}

/// Three digits are certain.
const CERTAIN: f64 = 1e-3;
/// What is smaller than this part of the longest vector need not be known better than that.
const SMALL: f64 = 0.1;

/// Refuses where friction lets no balance exist, or more than one, as scratch paper tells it, or where it leaves every
/// asked force open.
fn unstuck(
    scene: &Scene,
    structure: &Structure,
    plan: &Plan,
    readings: &[Reading],
) -> Result<(), SolveError> {
    let pairs = scene.mechanism.asked.iter().zip(readings);
    let mut forces = pairs.filter(|(asked, _)| matches!(asked.quantity, Quantity::Force(..))).peekable();
    if scene.mechanism.forces.friction.is_empty() || forces.peek().is_none() {
        return Ok(());
    }
    let mut at_rest = None;
    let mut answered = false;
    for (_, reading) in forces {
        match &reading.answer {
            Answer::Indeterminate(Indeterminate::Rubbing { how: Stuck::AtRest, why }) => {
                at_rest.get_or_insert(why);
            }
            Answer::Indeterminate(_) => {}
            _ => answered = true,
        }
    }
    match at_rest {
        // What does not move leaves only its own forces open.
        Some(_) if answered => Ok(()),
        Some(why) => Err(SolveError::Stuck { how: Stuck::AtRest, why: why.clone() }),
        None => match graphical::holds((&scene.mechanism, structure, plan)) {
            Some((how, why)) => Err(SolveError::Stuck { how, why }),
            None => Ok(()),
        },
    }
}

/// Draws the turning-moment diagram, where the scene has one, and reads off what is asked of it.
fn turn(scene: &Scene, settings: Settings, solution: &mut Solution) {
    let forces = &scene.mechanism.forces;
    let Some(cycle) = &forces.cycle else { return };
    let asked = scene.mechanism.asked.iter().filter_map(|asked| match asked.quantity {
        Quantity::Cycle(of) => Some(of),
        _ => None,
    });
    let asked: Vec<CycleQuantity> = asked.collect();
    let turned = turned(&scene.mechanism, cycle);
    let at = |angle: f64| turned.as_ref().and_then(|turned| turned.torque(angle));
    let knots = forces.knots();
    let own = turned.is_some().then_some(OwnTorque { at: &at, knots: &knots });
    let comes_back = turned.as_ref().map_or(Ok(()), |turned| turned.comes_back(&scene.mechanism));
    let drawn = comes_back
        .and_then(|()| graphical::cycle::draw(settings.arithmetic, cycle, forces.gravity.g, &asked, own));
    let construction = &mut solution.construction;
    for (asked, reading) in scene.mechanism.asked.iter().zip(&mut construction.answers) {
        let Quantity::Cycle(of) = asked.quantity else { continue };
        reading.answer = match &drawn {
            Ok(sheet) => sheet.answer(of),
            Err(why) => Answer::Indeterminate(Indeterminate::Undefined { why: why.clone() }),
        };
    }
    construction.cycle = drawn.ok();
}

/// A mechanism whose own torque is a side of its turning-moment diagram, ready to be led through the period.
struct Turned {
    sweep: sweep::Sweep,
    /// What was found at an angle (its bits): whoever draws the diagram asks it again.
    known: RefCell<BTreeMap<u64, Option<(f64, f64)>>>,
}

/// The mechanism at constant speed of its input, where the diagram wants its torque.
fn turned(mechanism: &Mechanism, cycle: &Cycle) -> Option<Turned> {
    cycle.of()?;
    let mut mechanism = mechanism.clone();
    mechanism.forces.cycle = None;
    let twists = mechanism.springs_that_wind_up().map(Force::Twist);
    let asked = |torque: Force| Asked {
        name: torque.name(&mechanism),
        quantity: Quantity::Force(torque, Share::Total),
        unit: Unit { symbol: "N*m".to_owned(), si: 1.0 },
        method: Method::default(),
    };
    mechanism.asked = std::iter::once(Force::Torque(0)).chain(twists).map(asked).collect();
    mechanism.run_steadily();
    let turns = mechanism.turns_of_loads()?;
    let range = (turns > 1).then(|| [0.0, f64::from(turns) * std::f64::consts::TAU]);
    let sweep = sweep::Sweep::new(&mechanism, range).ok()?;
    Some(Turned { sweep, known: RefCell::default() })
}

/// So far beside a place where a load has no direction it has one, radians.
const BESIDE: f64 = 1e-6;

/// A number of a sweep is known within so many of its errors.
const ERRORS: f64 = 8.0;

impl Turned {
    /// The place of the sweep at which the input stands at this angle.
    fn place(&self, angle: f64) -> f64 {
        let [from, to] = self.sweep.range;
        let round = to - from;
        let times = libm::floor((angle - from) / round);
        (angle - times * round).clamp(from, to)
    }

    /// Whether every torsion spring is wound up after a period as it was before; why not, if not.
    fn comes_back(&self, mechanism: &Mechanism) -> Result<(), String> {
        let [before, after] = self.sweep.range.map(|end| self.sweep.at(end).unwrap_or_default());
        // The first number is the torque at the input.
        let twists = before.iter().zip(&after).skip(1).zip(mechanism.springs_that_wind_up());
        for ((before, after), spring) in twists {
            if let (Some(before), Some(after)) = (before, after)
                && (after.value - before.value).abs() > ERRORS * (after.error + before.error)
            {
                return Err(mechanism.say_wound_up(spring));
            }
        }
        Ok(())
    }

    /// T(2), N m, and how far it may be off.
    fn torque(&self, angle: f64) -> Option<(f64, f64)> {
        if let Some(known) = self.known.borrow().get(&angle.to_bits()) {
            return *known;
        }
        let found = self.found(angle);
        self.known.borrow_mut().insert(angle.to_bits(), found);
        found
    }

    fn found(&self, angle: f64) -> Option<(f64, f64)> {
        if let Some(found) = self.at(angle) {
            return Some(found);
        }
        // Where a loaded point turns back its direction is none, and the torque that of either side.
        let side = |step: f64| -> Option<(f64, f64)> {
            let [one, two, three] =
                [self.at(angle + step)?, self.at(angle + 2.0 * step)?, self.at(angle + 3.0 * step)?];
            // On along a straight line; a parabola tells how far off that may be.
            let (line, curve) = (2.0 * one.0 - two.0, 3.0 * (one.0 - two.0) + three.0);
            Some((line, 3.0 * (one.1 + two.1 + three.1) + 2.0 * (line - curve).abs()))
        };
        let (before, after) = (side(-BESIDE)?, side(BESIDE)?);
        Some((f64::midpoint(before.0, after.0), before.1 + after.1 + (before.0 - after.0).abs()))
    }

    fn at(&self, angle: f64) -> Option<(f64, f64)> {
        let torque = self.sweep.at(self.place(angle))?.first().copied().flatten()?;
        let (value, error) = (torque.value, ERRORS * torque.error);
        // What is told no better than by its size is told by its neighbours.
        (value.is_finite() && error.is_finite() && error <= value.abs().max(1e-9)).then_some((value, error))
    }
}

/// A plan for as much of the skeleton as can be drawn: the groups that cannot, and what depends on them, are left out,
/// where nothing asked needs them.
fn without_the_impossible(
    scene: &Scene,
    structure: &Structure,
    plan: &mut Plan,
    first: DrawError,
    plan_from: &dyn Fn(CentreSource, &BTreeSet<usize>) -> Plan,
) -> Result<LeftOut, SolveError> {
    let mechanism = &scene.mechanism;
    let asked = Plan::new(mechanism, structure, Extent::Asked);
    let needed: BTreeSet<usize> = asked.steps(Order::Position).iter().map(|step| step.group).collect();
    if plan.steps(Order::Position).iter().all(|step| needed.contains(&step.group)) {
        // Nothing is there that could be left out: what was found out once holds.
        return Err(first.into());
    }
    // What is asked is told of as if nobody wanted the rest.
    graphical::extents(mechanism, structure, &asked)?;
    let mut groups = BTreeSet::new();
    loop {
        let planned = plan.steps(Order::Position).iter().map(|step| step.group);
        let idle: Vec<usize> = planned.filter(|group| !needed.contains(group)).collect();
        // Groups stand in the order in which they depend on each other.
        let closes = |count: usize| {
            let kept = |group: usize| needed.contains(&group) || idle[..count].contains(&group);
            graphical::seen(mechanism, structure, &plan.skeleton_of(kept)).is_ok()
        };
        if closes(idle.len()) {
            break;
        }
        let counts: Vec<usize> = (0..=idle.len()).collect();
        let fails = counts.partition_point(|count| closes(*count));
        let Some(&group) = fails.checked_sub(1).and_then(|last| idle.get(last)) else {
            return Err(first.into());
        };
        groups.insert(group);
        *plan = plan_from(CentreSource::Diagram, &groups);
    }
    if groups.is_empty() {
        return Err(first.into());
    }
    let drawn: BTreeSet<usize> = plan.steps(Order::Position).iter().map(|step| step.group).collect();
    let missing = (0..structure.groups.len()).filter(|group| !drawn.contains(group));
    let links = missing.flat_map(|group| structure.groups[group].links.clone());
    let mut links: Vec<u32> = links.map(|link| mechanism.link(link).number).collect();
    links.sort_unstable();
    Ok(LeftOut { links, why: first, groups })
}

/// The errors that careful draughtsmen make in each asked quantity, at the scales of the solution.
///
/// # Errors
/// [`SolveError::Draw`], where not even a perfect hand can draw it.
pub fn by_hand(
    scene: &Scene,
    solved: &Solved,
    draughtsmen: Draughtsmen,
) -> Result<Vec<HandError>, SolveError> {
    let mut errors =
        graphical::by_hand(&scene.mechanism, &solved.structure, &solved.plan, solved.scales, draughtsmen)?;
    let asked = cycle_quantities(&scene.mechanism);
    if asked.is_empty() {
        return Ok(errors);
    }
    // Whoever looks for a torque at many angles looks at fewer diagrams.
    let turns = scene.mechanism.forces.cycle.as_ref().is_some_and(|cycle| cycle.of().is_some());
    let number = draughtsmen.number.min(if turns { MOST_TURNS } else { MOST_DIAGRAMS });
    let drawn = cycle_by_hands(&scene.mechanism, solved.scales, (draughtsmen.hand, number));
    for (index, asked) in scene.mechanism.asked.iter().enumerate() {
        let Quantity::Cycle(of) = asked.quantity else { continue };
        let Some(place) = cycle_quantities(&scene.mechanism).iter().position(|known| *known == of) else {
            continue;
        };
        let read: Vec<Option<f64>> = drawn.iter().map(|numbers| numbers[place]).collect();
        let perfect = match solved.solution.construction.answers.get(index).map(|reading| &reading.answer) {
            Some(Answer::Scalar { value, .. }) => Some(*value),
            _ => None,
        };
        if let Some(error) = errors.get_mut(index) {
            *error = graphical::errors_of(&read, perfect);
        }
    }
    Ok(errors)
}

/// Draughtsmen of a turning-moment diagram: each takes as long as a whole sheet of motion.
const MOST_DIAGRAMS: u64 = 96;
/// Draughtsmen of a turning-moment diagram for which the mechanism has to be led through its period.
const MOST_TURNS: u64 = 24;

/// What is asked of the turning-moment diagram.
#[must_use]
pub fn cycle_quantities(mechanism: &Mechanism) -> Vec<CycleQuantity> {
    let of = |asked: &Asked| match asked.quantity {
        Quantity::Cycle(of) => Some(of),
        _ => None,
    };
    mechanism.asked.iter().filter_map(of).collect()
}

/// What each of so many draughtsmen reads off the turning-moment diagram, in the order of [`cycle_quantities`]; none where
/// it has no such number. Their slips follow from their numbers.
#[must_use]
pub fn cycle_by_hands(
    mechanism: &Mechanism,
    scales: Scales,
    (hand, number): (Hand, u64),
) -> Vec<Vec<Option<f64>>> {
    let asked = cycle_quantities(mechanism);
    let nothing = || vec![vec![None; asked.len()]; number as usize];
    let Some(cycle) = &mechanism.forces.cycle else { return nothing() };
    let paper = match (scales.paper().cycle, &cycle.sides) {
        (Some(paper), _) => paper,
        // Areas that are given stand on no paper of his.
        (None, Sides::Areas { .. }) => [1.0; 2],
        (None, _) => return nothing(),
    };
    // All look at one mechanism.
    let turned = turned(mechanism, cycle);
    let by = |seed| {
        let drawn = graphical::cycle_by_hand::drawn_by_hand(cycle, paper, hand, seed);
        let missed = |at| drawn.missed(at);
        let numbers = numbers_of_cycle(mechanism, (&drawn.cycle, turned.as_ref()), &asked, &missed);
        asked.iter().zip(numbers).map(|(of, number)| Some(drawn.read(*of, number?))).collect()
    };
    (0..number).map(by).collect()
}

/// The numbers of a mechanism's turning-moment diagram without their bounds.
#[must_use]
pub fn cycle_numbers(mechanism: &Mechanism, cycle: &Cycle, asked: &[CycleQuantity]) -> Vec<Option<f64>> {
    let turned = turned(mechanism, cycle);
    numbers_of_cycle(mechanism, (cycle, turned.as_ref()), asked, &|_| 0.0)
}

/// The same; `missed` is added to the mechanism's own torque.
fn numbers_of_cycle(
    mechanism: &Mechanism,
    (cycle, turned): (&Cycle, Option<&Turned>),
    asked: &[CycleQuantity],
    missed: &dyn Fn(f64) -> f64,
) -> Vec<Option<f64>> {
    let at = |angle: f64| {
        let (torque, error) = turned?.torque(angle)?;
        Some((torque + missed(angle), error))
    };
    let knots = mechanism.forces.knots();
    let own = turned.is_some().then_some(OwnTorque { at: &at, knots: &knots });
    if turned.is_some_and(|turned| turned.comes_back(mechanism).is_err()) {
        return vec![None; asked.len()];
    }
    let drawn = graphical::cycle::draw(Arithmetic::Double, cycle, mechanism.forces.gravity.g, asked, own);
    let Ok(sheet) = drawn else { return vec![None; asked.len()] };
    let number = |of: &CycleQuantity| match sheet.answer(*of) {
        Answer::Scalar { value, .. } => Some(value),
        _ => None,
    };
    asked.iter().map(number).collect()
}

impl Solved {
    /// The answer to the question of this name, as the scene words it: `v(B)`. `None` where the scene does not ask it.
    #[must_use]
    pub fn answer(&self, scene: &Scene, name: &str) -> Option<&Answer> {
        let index = scene.mechanism.asked.iter().position(|asked| asked.name == name)?;
        self.solution.construction.answers.get(index).map(|reading| &reading.answer)
    }
}

/// A governor led over the range of its input; none of a mechanism whose speed of equilibrium is not sought.
///
/// # Errors
/// Why it cannot be led there, in plain English.
pub fn governed(mechanism: &Mechanism, range: Option<[f64; 2]>) -> Result<Option<Governed>, String> {
    sweep::governor::governed(mechanism, range).map_err(|error| error.to_string())
}

/// Refuses where none of the asked quantities is determined.
///
/// # Errors
/// [`SolveError::Indeterminate`], or [`SolveError::Unanswered`] where it is not the position's fault.
pub fn determined(asked: &[Asked], readings: &[Reading]) -> Result<(), SolveError> {
    let mut reasons = Vec::new();
    for (asked, reading) in asked.iter().zip(readings) {
        match &reading.answer {
            Answer::Indeterminate(why) => reasons.push((asked.name.clone(), why.clone())),
            _ => return Ok(()),
        }
    }
    let position = reasons.iter().position(|(_, why)| !matches!(why, Indeterminate::Undefined { .. }));
    match (position, reasons.into_iter().nth(position.unwrap_or(0))) {
        (_, None) => Ok(()),
        (Some(_), Some((name, why))) => Err(SolveError::Indeterminate { name, why }),
        (None, Some((name, why))) => Err(SolveError::Unanswered { name, why }),
    }
}

/// Solves the same scene with the independent solver, as far as the asked quantities need.
///
/// # Errors
/// See [`AnalyticError`].
pub fn solve_analytically(scene: &Scene) -> Result<State, AnalyticError> {
    let asked: Vec<Quantity> = scene.mechanism.asked.iter().map(|asked| asked.quantity).collect();
    solve_analytically_for(scene, &asked)
}

/// Solves what a scene asks besides with the independent solver.
///
/// # Errors
/// See [`AnalyticError`].
pub fn solve_analytically_for(scene: &Scene, quantities: &[Quantity]) -> Result<State, AnalyticError> {
    let mechanism = &scene.mechanism;
    let Some(cycle) = &mechanism.forces.cycle else {
        return analytic::solve_what_closes(mechanism, quantities);
    };
    let turned = turned(mechanism, cycle);
    let at = |angle: f64| turned.as_ref().and_then(|turned| turned.sweep.marked_at(turned.place(angle)));
    let standing: Option<analytic::Standing<'_>> = if turned.is_some() { Some(&at) } else { None };
    analytic::solve_cycle(mechanism, quantities, standing)
}
