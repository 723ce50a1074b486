//! One student's answers beside the right construction: what each answer is of, in which step it is found, what
//! any changed construction would make of it, and how far off a careful hand may be.

use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::collections::{BTreeMap, HashSet};
use std::f64::consts::PI;

use super::answers::{Answers, FigurePoints, Form, Given, StatedScales, Tolerance, is_vector};
use super::change::{Change, InRadians, InputChange, Misreading, Stray, Which};
use super::feet;
use super::force_mistakes::same as same_force;
use super::is_prime;
use super::phrase::{Phrase, say};
use super::symbols::{ANGULAR_ACCELERATION, Symbols};
use super::turned::{self, Turns};
use super::unread::Unread;
use super::{GradeError, GradeSettings};
use crate::board::Hand;
use crate::graphical::construction::{
    Act, Calculation, Claim, Construction, ConstructionLine, ForceSheet, FreeBody, Label, Reference,
};
use crate::graphical::cycle::CycleSheet;
use crate::graphical::{Departure, Paper, Scales, Searched, Sketch, Slip, Slips, free_bodies, sketch};
use crate::limits;
use crate::mechanism::cycle::{CycleQuantity, RotatingInertia};
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Answer, Asked, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::{Extent, Plan};
use crate::scene::Scene;
use crate::sheet::{Language, OwnForce, Symbol};
use crate::solve::{self, Solved};
use crate::tolerance::{self, Ground, Standard, Tolerated};

/// What an answer is of.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Target {
    /// A quantity, by its index among the asked ones of [`Case::mechanism`].
    Asked(usize),
    /// A point of a polygon, by its vector from the pole.
    Image(Order, Label),
    /// A point of the skeleton.
    Place(PointId),
    /// How far a point (metres in the world) lies from the line of a force, by its index among the asked ones.
    Line(usize, [f64; 2]),
}

/// One answer.
#[derive(Debug, Clone)]
pub(super) struct Observation {
    /// As the file names it; points with their figure.
    pub(super) name: String,
    pub(super) target: Target,
    /// The quantity, where it is one.
    pub(super) quantity: Option<Quantity>,
    /// SI; never [`Given::Drawn`].
    pub(super) given: Given,
    /// The same as it was handed in, where [`Self::given`] is what it comes to.
    pub(super) written: Option<Given>,
    /// A foot of a polygon as the student letters it.
    pub(super) letter: Option<Label>,
    /// It was measured on the drawing by the student: no scale was used.
    pub(super) on_paper: bool,
    /// In which form it was written.
    pub(super) form: Form,
    pub(super) unit: Unit,
    /// Half a unit in the last place that was written, SI.
    pub(super) rounding: f64,
    /// A tolerance that somebody states, SI.
    pub(super) stated: Option<f64>,
    /// Where in the order of the solution it is found.
    pub(super) rank: (Order, usize, usize),
}

/// Answers and the right construction.
#[derive(Debug)]
pub(super) struct Case<'s> {
    pub(super) scene: &'s Scene,
    /// The scene's mechanism, with every answered quantity asked.
    pub(super) mechanism: Mechanism,
    pub(super) structure: Structure,
    pub(super) plan: Plan,
    pub(super) scales: Scales,
    /// Those of them that the student states.
    pub(super) stated: StatedScales,
    pub(super) hand: Hand,
    pub(super) draughtsmen: u64,
    /// What was found by trial so far.
    searched: Searched,
    /// The right drawing.
    pub(super) right: Sketch,
    pub(super) observations: Vec<Observation>,
    /// Of each answer, what is right.
    pub(super) truth: Vec<Option<Vec<f64>>>,
    /// Of each answer, by how much it may be off.
    pub(super) rooms: Vec<Room>,
    /// Of each answer, how that was found.
    pub(super) allowances: Vec<Allowance>,
    /// What tolerances hang on.
    ground: Ground,
    /// The same of what the scene itself asks, as the key of an exam has it.
    keyed: Vec<Tolerated>,
    /// The free bodies of the right solution, where forces are asked.
    sheet: Option<ForceSheet>,
    /// The right turning-moment diagram, where there is one.
    pub(super) cycle: Option<CycleSheet>,
    /// Inertia that turns in it, kg m², referred to the input.
    pub(super) rotating: f64,
    /// The numbers of the turning-moment diagram, by what was changed of the mechanism.
    turned: RefCell<Vec<(Vec<InputChange>, Numbers)>>,
    /// By how much each of some draughtsmen is off in them.
    turned_by_hand: OnceCell<Vec<Numbers>>,
    /// How the student's drawing lies on its sheet.
    pub(super) turns: Turns,
    /// Every quantity that was named, by its name in a scene.
    named: RefCell<BTreeMap<String, Quantity>>,
    /// How far each fixed point stands from its place on the skeleton that was handed in, metres, where that is far.
    pub(super) pivots: Vec<(PointId, [f64; 2])>,
    /// How many times larger than at the sheet's scale the skeleton was drawn as a whole, where that is not 1.
    pub(super) enlarged: Option<f64>,
    /// The scales of the polygons for which none was stated, as they tell them themselves, or lengths that were measured on
    /// them; SI units per millimetre.
    pub(super) own_scales: Vec<(Order, f64)>,
    /// Whether sense and direction have marks of their own.
    pub(super) by_parts: bool,
    /// Whether the answers state tolerances that do not count.
    pub(super) tolerances_ignored: bool,
    /// What of the answers is not understood.
    pub(super) unread: Vec<Unread>,
    /// In which language everything is told.
    pub(super) language: Language,
}

/// By how much an answer may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Room {
    /// The number, the magnitude of a vector, each coordinate of a place, or the distance of a mark; SI.
    pub(super) by: f64,
    /// The direction of a vector, radians; infinite where there is none to be told.
    pub(super) turn: f64,
}

impl Room {
    /// Of what has no direction.
    fn of(by: f64) -> Self {
        Self { by, turn: f64::INFINITY }
    }

    /// So many times as wide.
    pub(super) fn times(self, factor: f64) -> Self {
        Self { by: factor * self.by, turn: factor * self.turn }
    }

    /// The same for a vector that is so long instead of `right`: whoever is off by as much at the head of a shorter one is off
    /// by more of its direction.
    pub(super) fn of_size(self, long: f64, right: Option<f64>) -> Self {
        let shorter = right.filter(|_| long > 0.0).map_or(1.0, |right| (right / long).max(1.0));
        Self { turn: (self.turn * shorter).max(self.turn), ..self }
    }

    /// The wider of two.
    pub(super) fn or(self, other: Self) -> Self {
        Self { by: self.by.max(other.by), turn: self.turn.max(other.turn) }
    }

    /// The narrower of two.
    pub(super) fn and(self, other: Self) -> Self {
        Self { by: self.by.min(other.by), turn: self.turn.min(other.turn) }
    }

    /// How many times wider than another.
    pub(super) fn against(self, other: Self) -> f64 {
        let turn = if other.turn.is_finite() { self.turn / other.turn } else { 0.0 };
        (self.by / other.by).max(turn)
    }
}

/// By how much an answer may be off, and why. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Allowance {
    pub(super) room: Room,
    /// What it would be without a cap.
    pub(super) free: Room,
    /// What nineteen of twenty careful hands stay within.
    pub(super) honest: Room,
    pub(super) basis: Basis,
    /// A careful hand may be off by more than the cap.
    pub(super) loose: bool,
    /// The number is so small that more than the cap is allowed.
    pub(super) over_cap: bool,
}

impl From<tolerance::Allowance> for Allowance {
    fn from(allowed: tolerance::Allowance) -> Self {
        let turn = |of: fn(tolerance::Room) -> f64| allowed.direction.map_or(f64::INFINITY, of);
        Self {
            room: Room { by: allowed.size.by, turn: turn(|room| room.by) },
            free: Room { by: allowed.size.free, turn: turn(|room| room.free.max(room.by)) },
            honest: Room { by: allowed.size.honest, turn: turn(|room| room.honest) },
            basis: match allowed.basis {
                tolerance::Basis::Calculated => Basis::Calculated,
                tolerance::Basis::Read => Basis::Read,
            },
            loose: allowed.loose(),
            over_cap: allowed.size.over_cap,
        }
    }
}

/// Why an answer may be off by what it may.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Basis {
    /// The answers state it.
    Stated,
    /// It is calculated from what is given: no drawing is behind it.
    Calculated,
    /// It is read off the drawing, or calculated from what is.
    Read,
}

/// Numbers of the turning-moment diagram, in the order in which they are asked.
type Numbers = Vec<Option<f64>>;

/// So many draughtsmen draw a turning-moment diagram.
const TURNING: u64 = 24;

/// The points of a student's figure by what they are, millimetres.
pub(super) struct Found<'f> {
    pub(super) figure: &'f FigurePoints,
    pub(super) points: Vec<(&'f str, [f64; 2], Target)>,
}

/// A figure as answers name it.
pub(super) fn figure_name(order: Order) -> &'static str {
    match order {
        Order::Position => "skeleton",
        Order::Velocity => "velocity",
        Order::Acceleration => "acceleration",
    }
}

/// How a student's figure lies against the right one, both in millimetres.
struct Laid {
    from: [f64; 2],
    to: [f64; 2],
    turn: f64,
}

impl Laid {
    /// A point of the student's figure in the coordinates of the right one.
    fn right(&self, at: [f64; 2]) -> [f64; 2] {
        let [x, y] = [at[0] - self.from[0], at[1] - self.from[1]];
        let (sin, cos) = (libm::sin(self.turn), libm::cos(self.turn));
        [self.to[0] + cos * x - sin * y, self.to[1] + sin * x + cos * y]
    }
}

impl<'s> Case<'s> {
    pub(super) fn new(
        scene: &'s Scene,
        answers: &Answers,
        settings: &GradeSettings,
    ) -> Result<Self, GradeError> {
        let own = solve::solve(scene, Extent::WholeSkeleton, crate::sheet::scale::for_scene)?;
        // Nobody is graded by a solution that is not confirmed.
        crate::check::confirm(scene, &own)?;
        let (answers, mut unread) = on_a_sheet(&own, answers);
        let answers = &*answers;
        let scales =
            Scales::new(|dimension| answers.scales.of(dimension).unwrap_or(own.scales.of(dimension)));
        // Nobody sets the tolerance of what he hands in.
        let trusted = settings.trusts_answers.then_some(answers);
        let standard = Standard {
            hand: Hand {
                length: trusted.and_then(|own| own.hand.0).unwrap_or(settings.hand.length),
                angle: trusted.and_then(|own| own.hand.1).unwrap_or(settings.hand.angle),
            },
            draughtsmen: settings.draughtsmen,
            max_tolerance: settings.max_tolerance,
        };
        let keyed = keyed(scene, own, (scales, answers), standard)?;
        let asking = asking(scene, answers);
        let Solved { structure, plan, solution, .. } = solve::solve(&asking, Extent::Asked, |_, _| scales)?;
        let construction = solution.construction;
        let paper = crate::sheet::force_paper(&asking, &construction);
        let newtons = answers.scales.force().or(paper.force).or_else(|| on_a_hand(&asking, &construction));
        let scales = scales.on(Paper { force: newtons, ..paper });
        let rotating = rotating(&asking.mechanism);
        let mechanism = asking.mechanism;
        let searched = Searched::default();
        let right = sketch(&mechanism, &structure, &plan, scales, (&[], &searched), None)
            .map_err(|error| GradeError::Solve(error.into()))?;
        let ground = Ground::new(&mechanism, &construction, scales, standard);
        let mut case = Self {
            scene,
            mechanism,
            structure,
            plan,
            scales,
            stated: answers.scales,
            hand: standard.hand,
            draughtsmen: settings.draughtsmen,
            searched,
            right,
            observations: Vec::new(),
            truth: Vec::new(),
            rooms: Vec::new(),
            allowances: Vec::new(),
            ground,
            keyed,
            sheet: construction.forces,
            cycle: construction.cycle,
            rotating,
            turned: RefCell::default(),
            turned_by_hand: OnceCell::new(),
            turns: Turns::default(),
            named: RefCell::default(),
            pivots: Vec::new(),
            enlarged: None,
            own_scales: Vec::new(),
            by_parts: settings.by_parts,
            tolerances_ignored: !settings.trusts_answers && answers.state_tolerances(),
            unread: Vec::new(),
            language: settings.language,
        };
        case.right = case.with_cycle(case.right.clone(), &Change::default(), None);
        case.observe_items(answers);
        let mut not_found = Vec::new();
        let figures = answers.figures.iter().map(|figure| case.found(answers, figure, &mut not_found));
        let figures: Vec<Found<'_>> = figures.collect();
        let own = case.own_scales(&figures);
        if !own.is_empty() {
            let mut at_own = answers.clone();
            own.iter().for_each(|(order, si_per_mm)| at_own.scales.tell(*order, Some(*si_per_mm)));
            let mut case = Self::new(scene, &at_own, settings)?;
            case.unread.splice(0..0, unread);
            case.own_scales = own;
            return Ok(case);
        }
        // A hand slips as much on a small drawing as on a large one.
        if let Some(factor) = case.skeletons_scale(&figures) {
            let mut at_own = answers.clone();
            at_own.scales.tell(Order::Position, Some(case.si_per_mm(Order::Position) / factor));
            let mut case = Self::new(scene, &at_own, settings)?;
            case.unread.splice(0..0, unread);
            case.enlarged = Some(factor);
            return Ok(case);
        }
        unread.extend(not_found);
        case.turns = turned::turns(&case.mechanism, &case.right.construction, &figures);
        for figure in figures {
            unread.extend(case.observe_points(answers, figure));
        }
        case.unread = answers.unread().into_iter().chain(unread).collect();
        for index in 0..case.unread.len() {
            let point = case.quantity_of_point(&case.unread[index].name);
            case.unread[index].quantity = case.unread[index].quantity.or(point);
        }
        if let (true, Some(first)) = (case.observations.is_empty(), case.unread.first()) {
            return Err(GradeError::Answers(first.why.clone()));
        }
        case.observations.sort_by_key(|observation| observation.rank);
        case.truth = case.seen(&case.right, &Change::default());
        for (observation, truth) in case.observations.iter_mut().zip(&case.truth) {
            let stated = trusted.iter().flat_map(|own| &own.tolerances);
            let stated = stated.into_iter().find(|(name, _)| *name == observation.name);
            observation.stated = stated.and_then(|(_, tolerance)| match *tolerance {
                Tolerance::Part(part) => truth.as_deref().map(|numbers| part * size(numbers)),
                Tolerance::Amount(amount) => Some(amount),
            });
        }
        case.allowances = case.allowances_of(&Change::default(), &case.truth, case.draughtsmen);
        for index in 0..case.observations.len() {
            if let Some(allowance) = case.keyed_allowance(index) {
                case.allowances[index] = allowance;
            }
        }
        case.rooms = case.allowances.iter().map(|allowance| allowance.room).collect();
        Ok(case)
    }

    fn observe_items(&mut self, answers: &Answers) {
        let start =
            self.mechanism.asked.len() - answers.items.len() - points_asked(self.scene, answers).len();
        for (index, item) in answers.items.iter().enumerate() {
            let quantity = item.asked.quantity;
            let si_per_mm = self.si_of(&quantity);
            let (given, on_paper, rounding) = match item.given {
                Given::Drawn(mm) => (Given::Magnitude(mm * si_per_mm), true, item.rounding * si_per_mm),
                given => (given, false, item.rounding),
            };
            self.observations.push(Observation {
                name: item.asked.name.clone(),
                target: Target::Asked(start + index),
                quantity: Some(quantity),
                given,
                written: None,
                letter: None,
                on_paper,
                form: item.form,
                unit: item.asked.unit.clone(),
                rounding,
                stated: None,
                rank: self.rank_of(&quantity),
            });
            if let Some(through) = item.through {
                let unit = self.scene.units.length.clone();
                let (order, step, place) = self.rank_of(&quantity);
                self.observations.push(Observation {
                    name: format!("{} through", item.asked.name),
                    target: Target::Line(start + index, through),
                    quantity: None,
                    given: Given::Signed(0.0),
                    written: None,
                    letter: None,
                    on_paper: false,
                    form: Form::Number,
                    unit,
                    rounding: 0.0,
                    stated: None,
                    rank: (order, step, place + 1),
                });
            }
        }
    }

    /// The scale of each polygon for which the student states none, where it was drawn as a whole as many times too large, or
    /// several lengths of it that he measured are: SI units per millimetre.
    fn own_scales(&self, figures: &[Found<'_>]) -> Vec<(Order, f64)> {
        let seen = self.seen(&self.right, &Change::default());
        let of = |order: Order| {
            if self.stated.of(order.dimension()).is_some() {
                return None;
            }
            let mut times: Vec<f64> = Vec::new();
            let mut told: Vec<f64> = Vec::new();
            for (observation, seen) in self.observations.iter().zip(&seen) {
                let Some(right) = seen.as_deref().map(size).filter(|right| *right > 0.0) else { continue };
                let Some(quantity) = observation.quantity.filter(|of| of.order() == order) else { continue };
                let given = match observation.given {
                    Given::Magnitude(given) | Given::Drawn(given) | Given::Signed(given) => given.abs(),
                    Given::Vector(given) => size(&given),
                };
                let on_paper = right / self.si_per_mm(order) > MEASURED;
                match observation.on_paper && Which::Vectors(order).includes(&quantity) {
                    true if on_paper => times.push(given / right),
                    true => {}
                    false => told.push(given / right),
                }
            }
            let factor = match figures.iter().find(|found| found.figure.order == order) {
                Some(found) => turned::own_size(&self.mechanism, &self.right.construction, found),
                None => of_lengths(times),
            };
            // What is calculated, and as many times too large, shows that it is no scale.
            let faster = |factor: &f64| told.iter().any(|own| is_of_scale(*own, *factor));
            factor
                .filter(|factor| !is_of_scale(*factor, 1.0) && !faster(factor))
                .map(|factor| (order, factor))
        };
        let factors = [Order::Velocity, Order::Acceleration].map(of);
        if let [Some((_, speed)), Some((_, acceleration))] = factors
            && is_of_scale(acceleration, speed * speed)
            && mixed_rates().any(|mixed| is_of_scale(speed, mixed))
        {
            return Vec::new();
        }
        factors.into_iter().flatten().map(|(order, factor)| (order, self.si_per_mm(order) / factor)).collect()
    }

    /// A quantity as a scene names it; the report tells what it is called on the sheet.
    pub(super) fn named(&self, quantity: &Quantity) -> String {
        let name = quantity.name(&self.mechanism);
        self.named.borrow_mut().insert(name.clone(), *quantity);
        name
    }

    /// What the report may name, by its name in scene and answers, as the sheet prints it.
    pub(super) fn symbols(&self) -> Symbols {
        let scene = self.scene;
        let mut all: Vec<(String, Symbol)> = Vec::new();
        let alone: fn(&str) -> Phrase = |name| Phrase::from(name);
        for observation in &self.observations {
            let (of, symbol): (fn(&str) -> Phrase, Symbol) = match (observation.target, observation.quantity)
            {
                (Target::Image(order, label), _) => {
                    let figure = match order {
                        Order::Velocity => |name: &str| say!("{} (velocity polygon)", name),
                        _ => |name: &str| say!("{} (acceleration polygon)", name),
                    };
                    let sheet = &self.right.construction;
                    (figure, crate::sheet::image_symbol(scene, sheet, label, order.diagram()))
                }
                (Target::Place(point), _) => {
                    let figure = |name: &str| say!("{} (skeleton)", name);
                    (figure, crate::sheet::symbol(scene, Quantity::Position(point)))
                }
                (Target::Line(index, _), _) => {
                    let line = |name: &str| say!("line of {}", name);
                    (line, crate::sheet::symbol(scene, self.mechanism.asked[index].quantity))
                }
                (Target::Asked(_), Some(quantity)) => (alone, self.symbol(quantity)),
                (Target::Asked(_), None) => continue,
            };
            let told = |name: &str| of(name).told(self.language);
            let symbol = Symbol { plain: told(&symbol.plain), html: told(&symbol.html) };
            all.push((observation.name.clone(), symbol));
        }
        // A point that is not read has the name that was written: no part of it is another point's.
        for name in self.unread.iter().map(|unread| &unread.name) {
            let figure: fn(&str) -> Phrase = match name.split_once(':').map(|(figure, _)| figure) {
                Some("velocity") => |name| say!("{} (velocity polygon)", name),
                Some("acceleration") => |name| say!("{} (acceleration polygon)", name),
                Some("skeleton") => |name| say!("{} (skeleton)", name),
                _ => continue,
            };
            let (_, point) = name.split_once(':').unwrap_or_default();
            let told = |point: &str| figure(point).told(self.language);
            let symbol = Symbol { plain: told(point), html: told(&crate::markup::escaped(point)) };
            all.push((name.clone(), symbol));
        }
        let asked = self.scene.mechanism.asked.iter().map(|asked| (asked.name.clone(), asked.quantity));
        let named = self.named.borrow();
        let named = named.iter().map(|(name, quantity)| (name.clone(), *quantity));
        all.extend(asked.chain(named).map(|(name, quantity)| (name, self.symbol(quantity))));
        // As the sheet writes ε; without a link that moves nobody speaks of it.
        let letter = self.mechanism.moving().next().and_then(|link| {
            let symbol = crate::sheet::symbol(scene, Quantity::Alpha(link)).plain;
            symbol.chars().next().filter(|letter| ANGULAR_ACCELERATION.contains(letter))
        });
        Symbols::new(all, letter)
    }

    /// A quantity as the sheet prints it; a load without a name by the link on which it acts.
    fn symbol(&self, quantity: Quantity) -> Symbol {
        let load = match quantity {
            Quantity::Force(Force::Vector(Action::Load(index)) | Force::LoadTorque(index), _) => Some(index),
            _ => None,
        };
        let unnamed = load.map(|index| (index, &self.mechanism.forces.loads[index]));
        let unnamed = unnamed.filter(|(index, load)| load.name == format!("load {}", index + 1));
        match unnamed.map(|(_, load)| load.link) {
            Some(link) => {
                let told = say!("the load on link {}", self.mechanism.link(link).number).told(self.language);
                Symbol { plain: told.clone(), html: told }
            }
            None => crate::sheet::symbol(self.scene, quantity),
        }
    }

    /// Where in the order of the solution a quantity is found: forces after all motion, in the order in which bodies are
    /// balanced, and the turning-moment diagram last.
    fn rank_of(&self, quantity: &Quantity) -> (Order, usize, usize) {
        let place = match quantity {
            Quantity::Force(force, share) => {
                let shares = [Share::Static, Share::Inertia, Share::Total, Share::Rising, Share::Falling];
                let of_share = shares.iter().position(|known| known == share).unwrap_or(shares.len());
                10 * (10 * self.stage(*force) + of_share)
            }
            Quantity::Cycle(of) => 10 * (LAST + cycle_stage(*of)),
            // Centres are found on the skeleton, before any velocity.
            Quantity::Centre(..) => return (Order::Position, usize::MAX, 0),
            _ => return rank_of(&self.right.construction, quantity),
        };
        (Order::Acceleration, usize::MAX, 1 + place)
    }

    /// When a force is found.
    fn stage(&self, force: Force) -> usize {
        let bodies = self.sheet.as_ref().map_or(&[][..], |sheet| &sheet.bodies[..]);
        // Where it is found first, not where it is known already.
        let found = |action: Action| {
            let key = |action: Action| match action {
                Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
                Action::OnPin(link, pin) => Action::OfPin(pin, link),
                other => other,
            };
            let body =
                bodies.iter().position(|body| body.acting.iter().any(|a| key(a.action) == key(action)));
            let place = |body: usize| {
                let acting = bodies[body].acting.iter();
                acting.take_while(|acting| key(acting.action) != key(action)).count()
            };
            body.map_or(10 * bodies.len(), |body| 10 * body + place(body).min(9))
        };
        let of_action = |action: Action| match action {
            Action::Load(_) | Action::Weight(_) | Action::Spring { .. } | Action::Drag(_) => 0,
            Action::Inertia(_) | Action::Centrifugal(_) => 1,
            Action::Shaking => 4,
            Action::OnFrame => 11 + 10 * bodies.len(),
            Action::Drive(_) | Action::DriveBack(_) => 12 + 10 * bodies.len(),
            Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..) | Action::Rolling { .. } => {
                6 + found(action)
            }
        };
        match force {
            Force::Vector(action) => of_action(action),
            Force::Along { by, on, .. } | Force::Across { by, on, .. } => {
                of_action(Action::Pair { by, on }) - 1
            }
            Force::InertiaTorque(_) => 2,
            Force::Offset(_) => 3,
            Force::Moment(action, _) | Force::Arm(action, _) => 1 + of_action(action),
            Force::Pull(_) | Force::Twist(_) => 0,
            Force::Torque(_) | Force::Drive(_) | Force::LoadTorque(_) | Force::Spin => 12 + 10 * bodies.len(),
        }
    }

    /// The free bodies of a drawing that departs so.
    pub(super) fn bodies(&self, change: &Change) -> Option<ForceSheet> {
        let right = self.sheet.as_ref()?;
        if !change.redraws() {
            return Some(right.clone());
        }
        let mechanism = change.mechanism(&self.mechanism);
        let own =
            free_bodies(&mechanism, &self.structure, &self.plan, self.scales, &change.departures).ok()?;
        Some(own.unwrap_or_else(|| right.clone()))
    }

    /// A drawing with the numbers of the turning-moment diagram.
    fn with_cycle(&self, mut sketch: Sketch, change: &Change, draughtsman: Option<u64>) -> Sketch {
        let asked = solve::cycle_quantities(&self.mechanism);
        if asked.is_empty() {
            return sketch;
        }
        let mut numbers = self.turned(change, &asked);
        if let Some(seed) = draughtsman {
            let misses = self.turned_by_hand.get_or_init(|| {
                let right = self.turned(&Change::default(), &asked);
                let missed = |own: Numbers| {
                    own.into_iter().zip(&right).map(|(own, right)| Some(own? - (*right)?)).collect()
                };
                let by_hand = solve::cycle_by_hands(&self.mechanism, self.scales, (self.hand, TURNING));
                by_hand.into_iter().map(missed).collect()
            });
            if let Some(misses) = misses.get((seed % TURNING) as usize) {
                for (number, miss) in numbers.iter_mut().zip(misses) {
                    *number = number.zip(*miss).map(|(number, miss)| number + miss);
                }
            }
        }
        let mut numbers = numbers.into_iter();
        for (asked, read) in self.mechanism.asked.iter().zip(&mut sketch.numbers) {
            if matches!(asked.quantity, Quantity::Cycle(_)) {
                *read = numbers.next().flatten().map(|number| vec![number]);
            }
        }
        sketch
    }

    /// The numbers of the turning-moment diagram of a changed mechanism; what is drawn otherwise has no say in them.
    fn turned(&self, change: &Change, asked: &[CycleQuantity]) -> Numbers {
        if let Some((_, known)) = self.turned.borrow().iter().find(|(of, _)| *of == change.inputs) {
            return known.clone();
        }
        let mechanism = change.mechanism(&self.mechanism);
        let mut numbers = match &mechanism.forces.cycle {
            Some(cycle) => solve::cycle_numbers(&mechanism, cycle, asked),
            None => vec![None; asked.len()],
        };
        // What turns may be heavy enough for a wrong rate: who reckons on finds a flywheel lighter than nothing.
        let faster: Option<f64> = change.inputs.iter().try_fold(1.0, |product, change| match change {
            InputChange::Rates { omega, .. } => Some(product * omega),
            _ => None,
        });
        if let (Some(faster), false) = (faster, change.inputs.is_empty()) {
            let right = self.turned(&Change::default(), asked);
            for ((number, right), of) in numbers.iter_mut().zip(right).zip(asked) {
                if let (None, Some(right), CycleQuantity::Flywheel) = (*number, right, *of) {
                    *number = Some((right + self.rotating) / (faster * faster) - self.rotating);
                }
            }
        }
        self.turned.borrow_mut().push((change.inputs.clone(), numbers.clone()));
        numbers
    }

    /// SI units for a millimetre of what stands for a quantity on paper.
    pub(super) fn si_of(&self, quantity: &Quantity) -> f64 {
        self.ground.si_of(quantity)
    }

    /// The same of an answer.
    pub(super) fn si_of_answer(&self, observation: &Observation) -> f64 {
        match (observation.target, &observation.quantity) {
            (Target::Image(order, _), _) => self.si_per_mm(order),
            (_, Some(quantity)) => self.si_of(quantity),
            (_, None) => self.si_per_mm(Order::Position),
        }
    }

    /// The points of a figure by what they are; what names none is noted.
    fn found<'f>(&self, answers: &Answers, figure: &'f FigurePoints, unread: &mut Vec<Unread>) -> Found<'f> {
        let order = figure.order;
        let (known, printed) = (self.point_names(order), self.printed_names(order));
        let mut miss = |name: &str, at: usize, what: String, mend: String| {
            let name = format!("{}:{name}", figure_name(order));
            let why = answers.complain(at, what, Some(mend));
            unread.push(Unread { name, quantity: None, why });
        };
        let mut found = Vec::new();
        for (name, at, place) in figure.points.iter().map(|(name, at, place)| (name, *at, *place)) {
            let plain = plain_name(name, order);
            let target = known.iter().find(|(known, _)| *known == plain).map(|(_, target)| *target);
            // A foot on the way that has its label in common with a later one is a point of the solution, and judged by none.
            let is_on_the_way = || printed.iter().any(|(known, _, last)| *known == plain && !last);
            if target.is_none() && !is_on_the_way() {
                let figure = figure_name(order);
                let mut names: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
                let mut told = HashSet::new();
                names.retain(|name| told.insert(*name));
                names.truncate(16);
                let what = format!("the {figure} figure of this solution has no point `{name}`");
                miss(name, place, what, format!("its points are {}", names.join(", ")));
            }
            found.push(target.map(|target| (name.as_str(), at, target)));
        }
        for pair in &figure.shared {
            let place = |index: usize| -> Option<[f64; 2]> {
                match found.get(index)?.as_ref()?.2 {
                    Target::Image(_, Label::Pole) => Some([0.0; 2]),
                    Target::Image(order, label) => {
                        let images = &polygon(&self.right.construction, order)?.images;
                        images.iter().rev().find(|image| image.label == label).map(|image| image.at)
                    }
                    Target::Place(point) => self.right.construction.space.places[point.0],
                    Target::Asked(_) | Target::Line(..) => None,
                }
            };
            let [one, other] = pair.map(place);
            let one_point =
                one.zip(other).is_some_and(|(a, b)| libm::hypot(a[0] - b[0], a[1] - b[1]) <= ONE_POINT);
            if one_point {
                continue;
            }
            // Which of the two the mark is, nobody can tell.
            let [one, other] = pair.map(|index| figure.points.get(index).map_or("", |(name, ..)| name));
            let mend = format!(
                "give each a dot of its own, or write `{one}, {other}` in one text if they are one point"
            );
            for &index in pair {
                let place = figure.points.get(index).map_or(0, |(.., place)| *place);
                if let Some((name, ..)) = found.get_mut(index).and_then(Option::take) {
                    let what = format!("`{one}` and `{other}` stand beside one mark");
                    miss(name, place, what, mend.clone());
                }
            }
        }
        Found { figure, points: found.into_iter().flatten().collect() }
    }

    /// The vector or the place that a point of a figure shows, by its name in reports.
    fn quantity_of_point(&self, name: &str) -> Option<Quantity> {
        let (figure, point) = name.split_once(':')?;
        let order = super::answers::order_of(figure)?;
        let plain = plain_name(point, order);
        let (_, target) = self.point_names(order).into_iter().find(|(known, _)| *known == plain)?;
        match target {
            Target::Place(point) => Some(Quantity::Position(point)),
            Target::Image(Order::Velocity, Label::Image { point, link: None }) => {
                Some(Quantity::Velocity(point))
            }
            Target::Image(Order::Acceleration, Label::Image { point, link: None }) => {
                Some(Quantity::Acceleration(point))
            }
            _ => None,
        }
    }

    /// How many times larger than at the sheet's scale the skeleton is drawn as a whole, where none is stated.
    fn skeletons_scale(&self, figures: &[Found<'_>]) -> Option<f64> {
        if self.stated.of(Order::Position.dimension()).is_some() {
            return None;
        }
        let skeleton = figures.iter().find(|found| found.figure.order == Order::Position)?;
        turned::enlarged(&self.mechanism, &self.right.construction, skeleton)
    }

    /// Points of a figure, from its pole; those of the skeleton from its fixed points. Gives what is not read: where nothing
    /// tells how the figure lies, none of its points is.
    fn observe_points(&mut self, answers: &Answers, found: Found<'_>) -> Option<Unread> {
        let Found { figure, points } = found;
        let order = figure.order;
        // Nothing of it was understood, which is told already.
        if points.is_empty() {
            return None;
        }
        let Some(onto) = self.onto_figure(order, &points) else {
            let place = figure.points.first().map_or(0, |(.., place)| *place);
            let (what, mend) = match order {
                Order::Position => ("no fixed point of the skeleton is given", "give one, or better two"),
                _ => ("the pole is missing", "give it as `o`: vectors are measured from there"),
            };
            let why = answers.complain(place, what, Some(mend.to_owned()));
            return Some(Unread { name: format!("points.{}", figure_name(order)), quantity: None, why });
        };
        let si = self.si_per_mm(order);
        let points: Vec<_> =
            points.into_iter().map(|(name, at, target)| (name, onto.right(at), target)).collect();
        let meant = self.meant(order, &points);
        for ((name, at, lettered), (meant, target)) in points.into_iter().zip(meant) {
            let (rank, quantity) = match target {
                Target::Image(_, Label::Pole) => continue,
                Target::Place(point) if self.mechanism.is_fixed(point) => {
                    if let Some(place) = self.right.construction.space.places[point.0] {
                        let by = [at[0] - place[0], at[1] - place[1]];
                        if size(&by) > ELSEWHERE {
                            self.pivots.push((point, by.map(|mm| mm * si)));
                        }
                    }
                    continue;
                }
                Target::Image(order, label) => (rank_of_label(&self.right.construction, order, label), None),
                Target::Place(point) => {
                    let quantity = Quantity::Position(point);
                    (rank_of(&self.right.construction, &quantity), None)
                }
                Target::Asked(_) | Target::Line(..) => continue,
            };
            let given = |at: [f64; 2]| Given::Vector([at[0] * si, at[1] * si]);
            self.observations.push(Observation {
                name: format!("{}:{name}", figure_name(order)),
                target,
                quantity,
                given: given(meant),
                written: (meant != at).then(|| given(at)),
                letter: match lettered {
                    Target::Image(_, letter @ Label::Foot { .. }) => Some(letter),
                    _ => None,
                },
                on_paper: true,
                form: Form::Paper,
                unit: self.unit_of(order),
                rounding: 0.0,
                stated: None,
                rank,
            });
        }
        None
    }

    /// What the points of a figure are, and where each would stand in the order of the solution (mm): feet are the student's to
    /// letter and to lay off.
    fn meant(&self, order: Order, points: &[(&str, [f64; 2], Target)]) -> Vec<([f64; 2], Target)> {
        let mut meant: Vec<([f64; 2], Target)> =
            points.iter().map(|(_, at, target)| (*at, *target)).collect();
        let Some(right) = polygon(&self.right.construction, order) else { return meant };
        let images: Vec<(usize, feet::Own)> = points
            .iter()
            .enumerate()
            .filter_map(|(index, (_, at, target))| match *target {
                Target::Image(_, label) => Some((index, feet::Own { label, at: *at })),
                _ => None,
            })
            .collect();
        let own: Vec<feet::Own> = images.iter().map(|(_, own)| *own).collect();
        for ((index, _), own) in images.iter().zip(feet::meant(right, &own)) {
            meant[*index] = (own.at, Target::Image(order, own.label));
        }
        meant
    }

    /// How a student's figure lies against the right one, the sheet turned back; `None` where nothing tells.
    fn onto_figure(&self, order: Order, found: &[(&str, [f64; 2], Target)]) -> Option<Laid> {
        let turn = self.turns.of_sheet();
        if order != Order::Position {
            let (_, pole, _) = found.iter().find(|(.., t)| matches!(t, Target::Image(_, Label::Pole)))?;
            return Some(Laid { from: *pole, to: [0.0; 2], turn });
        }
        let places = &self.right.construction.space.places;
        let turn = self.turns.of_skeleton();
        let laid = found.iter().filter_map(|(_, at, target)| match target {
            Target::Place(point) if self.mechanism.is_fixed(*point) => {
                Some(Laid { from: *at, to: places[point.0]?, turn })
            }
            _ => None,
        });
        // By the fixed point about which most others are where they should be: one of them may stand elsewhere.
        let near = |laid: &Laid| {
            let off = |(_, at, target): &&(&str, [f64; 2], Target)| match target {
                Target::Place(point) => places[point.0].is_some_and(|place| {
                    let own = laid.right(*at);
                    libm::hypot(own[0] - place[0], own[1] - place[1]) <= ELSEWHERE
                }),
                _ => false,
            };
            found.iter().filter(off).count()
        };
        laid.rev().max_by_key(near)
    }

    /// The points of a polygon by the names that the sheet prints, without primes and commas; and whether each is the one that is
    /// meant by its label, the last that was drawn.
    fn printed_names(&self, order: Order) -> Vec<(String, Label, bool)> {
        let Some(polygon) = polygon(&self.right.construction, order) else { return Vec::new() };
        let names = crate::sheet::image_names(self.scene, &self.right.construction, order.diagram());
        let all = names.into_iter().zip(&polygon.images);
        all.map(|((name, label), image)| {
            let last = polygon.images.iter().rev().find(|other| other.label == label);
            let [x, y] = last.map_or(image.at, |last| last.at);
            let is_meant = libm::hypot(x - image.at[0], y - image.at[1]) <= ONE_POINT;
            (plain_name(&name, order), label, is_meant)
        })
        .collect()
    }

    /// The points of a figure, by their names without primes and commas.
    fn point_names(&self, order: Order) -> Vec<(String, Target)> {
        if order == Order::Position {
            let places = self.right.construction.space.places.iter().enumerate();
            return places
                .filter(|(_, at)| at.is_some())
                .map(|(index, _)| (self.mechanism.points[index].name.clone(), Target::Place(PointId(index))))
                .collect();
        }
        let Some(polygon) = polygon(&self.right.construction, order) else { return Vec::new() };
        let mut names = vec![("o".to_owned(), Target::Image(order, Label::Pole))];
        // As the sheet prints them: it tells feet apart, of which several may have the same number by themselves.
        let printed = self.printed_names(order);
        let meant = printed.iter().filter(|(.., last)| *last);
        names.extend(meant.map(|(name, label, _)| (name.clone(), Target::Image(order, *label))));
        for image in &polygon.images {
            let name = crate::sheet::image_name(self.scene, image.label, order.diagram());
            let name = plain_name(&name, order);
            if !printed.iter().any(|(known, ..)| *known == name) {
                names.push((name, Target::Image(order, image.label)));
            }
        }
        // Where no other point has that name, an image goes by its letter alone.
        for image in &polygon.images {
            if let Label::Image { point, link: Some(_) } = image.label {
                let name = plain_name(&self.mechanism.point(point).name.to_lowercase(), order);
                if !names.iter().any(|(known, _)| *known == name) {
                    names.push((name, Target::Image(order, image.label)));
                }
            }
        }
        names
    }

    /// Whether the student says at which scale a vector was drawn.
    pub(super) fn states_scale(&self, of: Which) -> bool {
        match of {
            Which::One(Quantity::Force(force, _)) if force.is_vector() => self.stated.force().is_some(),
            Which::One(quantity) if quantity.order() != Order::Position => {
                self.stated.of(quantity.order().dimension()).is_some()
            }
            _ => true,
        }
    }

    /// SI units per millimetre of a figure.
    pub(super) fn si_per_mm(&self, order: Order) -> f64 {
        self.scales.of(order.dimension())
    }

    /// The unit of the vectors of a polygon.
    pub(super) fn unit_of(&self, order: Order) -> Unit {
        let units = &self.scene.units;
        let (length, time) = (&units.length, &units.time);
        match order {
            Order::Position => length.clone(),
            Order::Velocity => {
                Unit { symbol: format!("{}/{}", length.symbol, time.symbol), si: length.si / time.si }
            }
            Order::Acceleration => Unit {
                symbol: format!("{}/{}^2", length.symbol, time.symbol),
                si: length.si / (time.si * time.si),
            },
        }
    }

    /// What stands on the paper after a change; `None` where it cannot be drawn.
    pub(super) fn drawn(&self, change: &Change, draughtsman: Option<u64>) -> Option<Sketch> {
        let mechanism = change.mechanism(&self.mechanism);
        let by = draughtsman.map(|seed| (self.hand, seed));
        let drawn = |departures: &[Departure]| {
            let manner = (departures, &self.searched);
            let sketch = sketch(&mechanism, &self.structure, &self.plan, self.scales, manner, by).ok()?;
            Some(self.with_cycle(sketch, change, draughtsman))
        };
        if change.strays.is_empty() {
            return drawn(&change.departures);
        }
        // Where a stray line leads is seen on the drawing as it is without it; the same hand draws both.
        let mut departures = change.departures.clone();
        for stray in &change.strays {
            let without = drawn(&departures)?;
            departures.push(self.strayed(&without.construction, stray)?);
        }
        drawn(&departures)
    }

    /// Where the image stands to which a stray line leads.
    fn strayed(&self, construction: &Construction, stray: &Stray) -> Option<Departure> {
        let lines = &polygon(construction, stray.order)?.lines;
        let ray = |wanted: &dyn Fn(Claim, usize) -> bool| {
            lines.iter().find_map(|line| match *line {
                ConstructionLine::Ray { from, claim: Some(claim), step, .. } if wanted(claim, step) => {
                    Some((from, claim, step))
                }
                _ => None,
            })
        };
        let (from, _, step) = ray(&|claim, _| claim == stray.claim)?;
        let (other, held, _) = ray(&|claim, at| at == step && claim != stray.claim)?;
        let skeleton = self.with_this_skeleton(construction);
        let along = direction(skeleton, stray.by)?;
        let along = if stray.square { [-along[1], along[0]] } else { along };
        let across = claimed(skeleton, held)?;
        let sine = along[0] * across[1] - along[1] * across[0];
        if sine.abs() < FLAT {
            return None;
        }
        let apart = [other[0] - from[0], other[1] - from[1]];
        let far = (apart[0] * across[1] - apart[1] * across[0]) / sine;
        let label = construction.steps.get(step)?.acts.iter().find_map(|act| match *act {
            Act::MarkMeet { label, .. } => Some(label),
            _ => None,
        })?;
        let at = [from[0] + far * along[0], from[1] + far * along[1]];
        match label {
            Label::Image { point, link: Some(link) } if !self.holds(link, point) => {
                Some(Departure::Under { order: stray.order, pin: point, link, at })
            }
            Label::Image { point, .. } => Some(Departure::Image { order: stray.order, point, at }),
            _ => None,
        }
    }

    /// The right drawing, where a construction has the same skeleton: lines of its polygons lie as they claim to.
    pub(super) fn with_this_skeleton<'c>(&'c self, construction: &'c Construction) -> &'c Construction {
        let right = &self.right.construction;
        if right.space.places == construction.space.places { right } else { construction }
    }

    /// Whether anything was answered that is found in the polygon of this order.
    pub(super) fn answers(&self, order: Order) -> bool {
        self.observations.iter().any(|observation| match (observation.target, observation.quantity) {
            (Target::Image(of, _), _) => of == order,
            (_, quantity) => quantity.is_some_and(|quantity| quantity.order() == order),
        })
    }

    /// The same of what is not found by centres: of these no polygon is drawn.
    pub(super) fn draws(&self, order: Order) -> bool {
        let by_centres = |quantity: &Quantity| {
            let mut asked = self.scene.mechanism.asked.iter();
            asked.any(|asked| asked.quantity == *quantity && asked.method == Method::Centres)
        };
        self.observations.iter().any(|observation| match (observation.target, observation.quantity) {
            (Target::Image(of, _), _) => of == order,
            (_, quantity) => {
                let centre = matches!(quantity, Some(Quantity::Centre(..)));
                quantity.is_some_and(|of| of.order() == order && !centre && !by_centres(&of))
            }
        })
    }

    /// The free bodies of the right solution, where forces are asked.
    pub(super) fn balance(&self) -> Option<&ForceSheet> {
        self.sheet.as_ref()
    }

    /// A centre or a joint as the student has it and as it is right, mm from the skeleton's origin.
    pub(super) fn place_handed_in(&self, index: usize) -> Option<(Quantity, [f64; 2], [f64; 2])> {
        let observation = &self.observations[index];
        let (quantity, own) = match (place_given(observation), observation.quantity, observation.given) {
            (Some((point, at)), ..) => (Quantity::Position(point), at),
            (None, Some(quantity @ Quantity::Centre(..)), Given::Vector(at)) => (quantity, at),
            _ => return None,
        };
        let &[x, y] = self.truth[index].as_deref()? else { return None };
        let mm = |at: [f64; 2]| at.map(|metres| metres / self.si_per_mm(Order::Position));
        Some((quantity, mm(own), mm([x, y])))
    }

    /// A force as the student has it, N, on every body (its index) in whose polygon it stands.
    pub(super) fn force_handed_in(&self, index: usize) -> Vec<OwnForce> {
        let observation = &self.observations[index];
        let Some(Quantity::Force(Force::Vector(action), Share::Total)) = observation.quantity else {
            return Vec::new();
        };
        let Some(&[x, y]) = self.truth[index].as_deref() else { return Vec::new() };
        let own = match observation.given {
            Given::Vector(force) => force,
            Given::Magnitude(long) | Given::Drawn(long) if size(&[x, y]) > 0.0 => {
                [x, y].map(|part| part * long / size(&[x, y]))
            }
            _ => return Vec::new(),
        };
        let on_body = |(body, free): (usize, &FreeBody)| {
            let acting = free.acting.iter().find(|acting| same_force(acting.action, action))?;
            // On the other body of its pair it has the opposite sense.
            let along = acting.force[0] * x + acting.force[1] * y;
            let force = if along < 0.0 { own.map(|part| -part) } else { own };
            Some(OwnForce { body, action: acting.action, force })
        };
        self.balance().iter().flat_map(|sheet| sheet.bodies.iter().enumerate()).filter_map(on_body).collect()
    }

    /// The quantity that an answer tells, or that of the vector from which it is calculated.
    pub(super) fn read_from(&self, index: usize, sketch: &Sketch) -> Option<Quantity> {
        let quantity = self.observations[index].quantity?;
        let calculated = sketch.construction.steps.iter().flat_map(|s| &s.acts).find_map(|act| match *act {
            Act::Calculate(Calculation::Omega { link, quantity: of, .. })
                if quantity == Quantity::Omega(link) =>
            {
                Some(of)
            }
            Act::Calculate(Calculation::Alpha { link, quantity: of, .. })
                if quantity == Quantity::Alpha(link) =>
            {
                Some(of)
            }
            _ => None,
        });
        Some(calculated.unwrap_or(quantity))
    }

    /// What a student would answer who drew this and misread it so.
    pub(super) fn seen(&self, sketch: &Sketch, change: &Change) -> Vec<Option<Vec<f64>>> {
        self.observations.iter().map(|observation| self.seen_of(observation, sketch, change)).collect()
    }

    /// The same of one answer.
    pub(super) fn seen_at(&self, index: usize, sketch: &Sketch, change: &Change) -> Option<Vec<f64>> {
        self.seen_of(self.observations.get(index)?, sketch, change)
    }

    fn seen_of(&self, observation: &Observation, sketch: &Sketch, change: &Change) -> Option<Vec<f64>> {
        let mut numbers = match observation.target {
            Target::Asked(index) => sketch.numbers.get(index)?.clone()?,
            Target::Image(order, label) => {
                let images = &polygon(&sketch.construction, order)?.images;
                let image = images.iter().rev().find(|image| image.label == label)?;
                image.at.map(|mm| mm * self.si_per_mm(order)).to_vec()
            }
            Target::Place(point) => {
                sketch.construction.space.places[point.0]?.map(|mm| mm * self.scales.length()).to_vec()
            }
            Target::Line(index, at) => {
                let through = (*sketch.lines.get(index)?)?;
                let &[x, y] = sketch.numbers.get(index)?.as_deref()? else { return None };
                let length = libm::hypot(x, y);
                let away = (at[0] - through[0]) * y - (at[1] - through[1]) * x;
                if length > 0.0 { vec![away / length] } else { return None }
            }
        };
        for reading in &change.readings {
            match *reading {
                Misreading::LetterOf { order, of, by } if observation.target == Target::Image(order, of) => {
                    let images = &polygon(&sketch.construction, order)?.images;
                    let image = images.iter().rev().find(|image| image.label == by)?;
                    numbers = image.at.map(|mm| mm * self.si_per_mm(order)).to_vec();
                }
                Misreading::MeasuredFrom { of, tail } if observation.quantity == Some(of) => {
                    let [head, tail] = self.head_and(&sketch.construction, &of, tail)?;
                    numbers = vec![head[0] - tail[0], head[1] - tail[1]];
                }
                Misreading::MeasuredTo { of, head } if observation.quantity == Some(of) => {
                    let polygon = polygon(&sketch.construction, of.order())?;
                    let tail = polygon.vectors.iter().find(|v| v.quantity == of)?.from;
                    let head = match head {
                        Label::Pole => [0.0; 2],
                        _ => polygon.images.iter().find(|known| known.label == head)?.at,
                    };
                    let si = self.si_per_mm(of.order());
                    numbers = vec![(head[0] - tail[0]) * si, (head[1] - tail[1]) * si];
                }
                Misreading::Backwards { of, from } if observation.quantity == Some(of) => {
                    let [head, from] = self.head_and(&sketch.construction, &of, from)?;
                    numbers = vec![2.0 * from[0] - head[0], 2.0 * from[1] - head[1]];
                }
                Misreading::RateIn { of, omega } if observation.quantity == Some(of) => {
                    let asked = solve::cycle_quantities(&self.mechanism);
                    let change = Change::of_inputs(InputChange::Rates { omega, alpha: 1.0 });
                    let place = asked.iter().position(|known| Quantity::Cycle(*known) == of)?;
                    numbers = vec![self.turned(&change, &asked).get(place).copied()??];
                }
                Misreading::TakenFor { of, by } if observation.quantity == Some(of) => {
                    let mut asked = self.mechanism.asked.iter();
                    let place = asked.position(|asked| asked.quantity == by)?;
                    numbers = sketch.numbers.get(place)?.clone()?;
                }
                Misreading::Inverted { of } if observation.quantity == Some(of) => {
                    numbers.iter_mut().for_each(|number| *number = 1.0 / *number);
                }
                Misreading::Rounded { of } if observation.quantity == Some(of) => {
                    numbers = rounded(observation, &numbers);
                }
                Misreading::Plus { of, by } if observation.quantity == Some(of) => {
                    numbers.iter_mut().zip(by).for_each(|(number, by)| *number += by);
                }
                reading => self.misread(observation, reading, &mut numbers),
            }
        }
        numbers.iter().all(|n| n.is_finite()).then_some(numbers)
    }

    /// The head of a vector of a polygon and an image, SI, from the pole.
    fn head_and(&self, construction: &Construction, of: &Quantity, image: Label) -> Option<[[f64; 2]; 2]> {
        let order = of.order();
        let polygon = polygon(construction, order)?;
        let vector = polygon.vectors.iter().find(|v| v.quantity == *of)?;
        let image = match image {
            Label::Pole => [0.0; 2],
            _ => polygon.images.iter().find(|known| known.label == image)?.at,
        };
        Some([vector.to, image].map(|at| at.map(|mm| mm * self.si_per_mm(order))))
    }

    /// The direction that an answer has, if degrees that were read within its room were typed into a calculator in radians: it
    /// makes 57 times as much of what the reading is off. That many answers have such directions is no chance; those whose
    /// direction is right were not typed so.
    fn typed_as_read(&self, observation: &Observation, of: Which, how: InRadians, right: f64) -> Option<f64> {
        let among = |one: &Observation| matches!((one.given, one.quantity), (Given::Vector(_), Some(quantity)) if self.includes(of, &quantity));
        let (true, Given::Vector([x, y])) = (how.typed, observation.given) else { return None };
        let is_off = |index: usize| {
            let truth = self.truth.get(index).and_then(Option::as_deref);
            truth.is_some() && self.misses(index, truth)[1] > self.rooms[index].turn
        };
        let off = self.observations.iter().enumerate().filter(|(index, one)| among(one) && is_off(*index));
        if off.count() < TYPED {
            return None;
        }
        let index = self.observations.iter().position(|one| one.name == observation.name)?;
        let room = self.rooms.get(index)?.turn.to_degrees().min(MOST_TYPED);
        let own = libm::atan2(y, x);
        let off = libm::remainder(own - how.spoilt(right), 2.0 * std::f64::consts::PI);
        (off.abs() <= room).then_some(own)
    }

    fn misread(&self, observation: &Observation, reading: Misreading, numbers: &mut [f64]) {
        if let Misreading::Enlarged { order, factor } = reading {
            let on_paper =
                |quantity: &Quantity| observation.on_paper && Which::Vectors(order).includes(quantity);
            let enlarged = match observation.target {
                Target::Image(of, _) => of == order,
                _ => observation.quantity.as_ref().is_some_and(on_paper),
            };
            if enlarged {
                numbers.iter_mut().for_each(|n| *n *= factor);
            }
            return;
        }
        if let (Target::Image(order, _), Misreading::Turned { order: of, by }) = (observation.target, reading)
        {
            if let ([x, y], true) = (&mut *numbers, of == order) {
                let (sin, cos) = (libm::sin(by), libm::cos(by));
                [*x, *y] = [cos * *x - sin * *y, sin * *x + cos * *y];
            }
            return;
        }
        let Some(quantity) = observation.quantity else { return };
        if let Misreading::InRadians { of, how } = reading {
            if self.includes(of, &quantity)
                && let [x, y] = numbers
            {
                let (length, right) = (libm::hypot(*x, *y), libm::atan2(*y, *x));
                let angle =
                    self.typed_as_read(observation, of, how, right).unwrap_or_else(|| how.spoilt(right));
                [*x, *y] = [length * libm::cos(angle), length * libm::sin(angle)];
            }
            return;
        }
        if let Misreading::Fluctuation { factor, inertia } = reading {
            if let ([number], Quantity::Cycle(of)) = (numbers, quantity) {
                match of {
                    CycleQuantity::Fluctuation | CycleQuantity::OfEnergy | CycleQuantity::OfSpeed => {
                        *number *= factor;
                    }
                    CycleQuantity::Flywheel => *number = factor * (*number + inertia) - inertia,
                    _ => {}
                }
            }
            return;
        }
        if let Misreading::Mirrored { of, from_y } = reading {
            if self.includes(of, &quantity)
                && let [x, y] = numbers
            {
                [*x, *y] = if from_y { [*y, *x] } else { [*x, -*y] };
            }
            return;
        }
        let (of, twist) = match reading {
            Misreading::Twisted { of, twist } => (of, twist),
            Misreading::OtherScale { .. } if observation.on_paper => return,
            Misreading::OtherScale { of, factor } => (of, crate::graphical::Twist::scaled(factor)),
            Misreading::Unscaled { of, factor }
            | Misreading::Divided { of, factor }
            | Misreading::ScaledTwice { of, factor } => {
                if observation.on_paper {
                    return;
                }
                // What one unit of the answer is long on paper.
                let mm = observation.unit.si / self.si_of(&quantity);
                let factor = match reading {
                    Misreading::Divided { .. } => mm * mm * factor,
                    Misreading::ScaledTwice { .. } => factor / mm,
                    _ => mm * factor,
                };
                (of, crate::graphical::Twist::scaled(factor))
            }
            Misreading::Enlarged { .. }
            | Misreading::Turned { .. }
            | Misreading::RateIn { .. }
            | Misreading::Mirrored { .. }
            | Misreading::MeasuredFrom { .. }
            | Misreading::MeasuredTo { .. }
            | Misreading::Backwards { .. }
            | Misreading::Plus { .. }
            | Misreading::TakenFor { .. }
            | Misreading::LetterOf { .. }
            | Misreading::Inverted { .. }
            | Misreading::Rounded { .. }
            | Misreading::Fluctuation { .. }
            | Misreading::InRadians { .. } => return,
        };
        if !self.includes(of, &quantity) {
            return;
        }
        match numbers {
            [x, y] => {
                let (sin, cos) = (libm::sin(twist.turn), libm::cos(twist.turn));
                [*x, *y] = [twist.factor * (cos * *x - sin * *y), twist.factor * (sin * *x + cos * *y)];
            }
            [value] => *value *= twist.factor,
            _ => {}
        }
    }

    /// Whether a quantity is among those that were misread: what is calculated from what is given is read off nothing.
    pub(super) fn includes(&self, of: Which, quantity: &Quantity) -> bool {
        let driven = |point: PointId| {
            self.mechanism.inputs.iter().any(|input| match *input {
                Input::Angle { link, .. } | Input::Speed { link, .. } => {
                    self.mechanism.link(link).points.contains(&point)
                }
                Input::Slide { .. } => false,
            })
        };
        of.includes(quantity)
            && match of {
                Which::Read(_) => !self.ground.is_calculated(quantity),
                Which::Measured(_) => !self.ground.is_calculated(quantity) && !self.is_carried(quantity),
                Which::Found(_) => {
                    let sum = matches!(*quantity, Quantity::Acceleration(point) if driven(point));
                    !sum && !self.ground.is_calculated(quantity)
                }
                _ => true,
            }
    }

    /// Whether a vector is calculated by the rate of its link, which was found before it.
    fn is_carried(&self, quantity: &Quantity) -> bool {
        let carries = |act: &Act| match (act, quantity) {
            (Act::Calculate(Calculation::Speed { quantity: of, .. }), _) => of == quantity,
            (
                Act::Calculate(Calculation::Tangential { quantity: Quantity::Tangential(of), .. }),
                Quantity::Acceleration(point),
            ) => of == point,
            (Act::Calculate(Calculation::Tangential { quantity: of, .. }), _) => of == quantity,
            _ => false,
        };
        self.right.construction.steps.iter().flat_map(|step| &step.acts).any(carries)
    }

    /// Whether a point is one of a link.
    pub(super) fn holds(&self, link: LinkId, point: PointId) -> bool {
        self.mechanism.link(link).points.contains(&point)
    }

    /// The size of what is right, SI units, where that is known.
    pub(super) fn right_size(&self, index: usize) -> Option<f64> {
        self.truth[index].as_deref().map(size)
    }

    /// How many times larger than what is right the number is that would be seen, at least once: a reading may be off by so
    /// much more. Once where one of the two is not known, and beside a right zero, which nothing is a multiple of.
    pub(super) fn times_larger(&self, index: usize, seen: Option<&[f64]>) -> f64 {
        let times = seen.zip(self.right_size(index)).map(|(seen, right)| size(seen) / right);
        times.filter(|times| times.is_finite()).map_or(1.0, |times| times.max(1.0))
    }

    /// Vectors that are written in another unit of length than all others of their diagram, or of both, which are two or more,
    /// each with its unit as a part of theirs.
    pub(super) fn in_odd_units(&self) -> Vec<(Quantity, f64)> {
        // The unit of length in it: velocities and accelerations are written in one.
        let length = |quantity: &Quantity, unit: f64| {
            let time = self.scene.units.time.si;
            match quantity.order() {
                Order::Position => unit,
                Order::Velocity => unit * time,
                Order::Acceleration => unit * time * time,
            }
        };
        let of_motion = |quantity: &Quantity| {
            super::answers::is_vector(quantity)
                && !tolerance::is_place(quantity)
                && !matches!(quantity, Quantity::Force(..))
        };
        let vectors = || {
            self.observations.iter().filter(|one| !one.on_paper).filter_map(|one| {
                let quantity = one.quantity.filter(of_motion)?;
                Some((quantity, length(&quantity, one.unit.si)))
            })
        };
        let odd_among = |(quantity, own): (Quantity, f64), all: bool| {
            let beside = |other: &Quantity| *other != quantity && (all || other.order() == quantity.order());
            let mut others = vectors().filter(|(other, _)| beside(other)).map(|(_, unit)| unit);
            let first = others.next()?;
            let second = others.next()?;
            let is_one = |one: f64, other: f64| (one / other - 1.0).abs() <= ROUNDING;
            let alike = is_one(second, first) && others.all(|unit| is_one(unit, first));
            (alike && !is_one(own, first)).then_some((quantity, own / first))
        };
        let odd = |one: (Quantity, f64)| odd_among(one, false).or_else(|| odd_among(one, true));
        vectors().filter_map(odd).collect()
    }

    /// Whether a quantity is answered in revolutions a minute.
    pub(super) fn is_in_turns_a_minute(&self, quantity: &Quantity) -> bool {
        let unit = PI / 30.0;
        let mut answers = self.observations.iter().filter(|one| one.quantity.as_ref() == Some(quantity));
        answers.any(|one| (one.unit.si / unit - 1.0).abs() < ROUNDING)
    }

    /// How many millimetres of paper one unit of the answer of a quantity is long; 1 where it is not answered.
    pub(super) fn answer_on_paper(&self, quantity: &Quantity) -> f64 {
        let own = self.observations.iter().find(|one| one.quantity.as_ref() == Some(quantity));
        own.map_or(1.0, |own| own.unit.si / self.si_of(quantity))
    }

    /// Whether an answer tells a vector with its direction.
    pub(super) fn is_vector(&self, index: usize) -> bool {
        matches!(self.observations[index].given, Given::Vector(_))
    }

    /// How many times longer than it should be an answer is, where that is a vector that is read off a polygon and not
    /// calculated.
    pub(super) fn lengthened(&self, index: usize, order: Order) -> Option<f64> {
        self.lengthened_by(index, |quantity| self.includes(Which::Measured(order), quantity))
    }

    /// The same of whatever vector is among these.
    pub(super) fn lengthened_by(&self, index: usize, among: impl Fn(&Quantity) -> bool) -> Option<f64> {
        let observation = &self.observations[index];
        let right = self.right_size(index)?;
        let wanted = matches!(observation.target, Target::Asked(_))
            && !observation.on_paper
            && observation.quantity.as_ref().is_some_and(among);
        (wanted && right > self.rooms[index].by).then(|| self.given_size(index) / right)
    }

    /// How much a change of readings alone multiplies each answer.
    fn enlarged(&self, change: &Change) -> Vec<f64> {
        let only = Change { readings: change.readings.clone(), ..Change::default() };
        let enlarge = |observation: &Observation| {
            let mut unit =
                if observation.quantity.is_some_and(|q| is_vector(&q)) { vec![1.0, 0.0] } else { vec![1.0] };
            for reading in &only.readings {
                self.misread(observation, *reading, &mut unit);
            }
            size(&unit)
        };
        self.observations.iter().map(enlarge).collect()
    }

    /// By how much each answer may be off if this is what was drawn: more than the worst of many careful
    /// draughtsmen, and what was rounded in writing it down.
    pub(super) fn rooms_of(&self, change: &Change, seen: &[Option<Vec<f64>>], draughtsmen: u64) -> Vec<Room> {
        let allowances = self.allowances_of(change, seen, draughtsmen);
        // What is not the right drawing is not asked to be drawn as closely as a cap wants it.
        allowances.iter().map(|allowance| allowance.free).collect()
    }

    fn allowances_of(&self, change: &Change, seen: &[Option<Vec<f64>>], draughtsmen: u64) -> Vec<Allowance> {
        let mut worst = vec![Slip::default(); self.observations.len()];
        for seed in 0..draughtsmen {
            let Some(sketch) = self.drawn(change, Some(seed)) else { continue };
            for (index, (numbers, worst)) in self.seen(&sketch, change).iter().zip(&mut worst).enumerate() {
                if let (Some(numbers), Some(exact)) = (numbers, &seen[index])
                    && numbers.len() == exact.len()
                {
                    *worst = worst.worse(Slip::between(numbers, exact, self.turns(index)));
                }
            }
        }
        let factors = self.enlarged(change);
        let allowed = |index: usize| {
            let seen = seen[index].as_deref();
            let own = self.allowed(&self.observations[index], worst[index], factors[index], seen);
            // Where lines cross so flatly that the result is no number, only an exact hand would prove anything.
            match self.rooms.get(index) {
                Some(&usual)
                    if own.free.by > WIDE * usual.by
                        && seen.is_none_or(|seen| own.free.by > TELLS * size(seen)) =>
                {
                    Allowance { free: usual, room: own.room.and(usual), ..own }
                }
                _ => own,
            }
        };
        (0..self.observations.len()).map(allowed).collect()
    }

    /// What is right of a quantity that was answered and is a number.
    pub(super) fn right_number(&self, quantity: Quantity) -> Option<f64> {
        let place =
            self.observations.iter().position(|observation| observation.quantity == Some(quantity))?;
        match self.truth[place].as_deref()? {
            &[number] => Some(number),
            _ => None,
        }
    }

    /// Whether an answer is an angle, the same a turn later.
    fn turns(&self, index: usize) -> bool {
        matches!(self.observations[index].quantity, Some(Quantity::Angle(_)))
    }

    /// By how much an answer to what the scene asks may be off, as the key of an exam has it; what is asked twice has its
    /// answers in the same order.
    fn keyed_allowance(&self, index: usize) -> Option<Allowance> {
        let own = |observation: &Observation| {
            matches!(observation.target, Target::Asked(_))
                && !observation.on_paper
                && observation.stated.is_none()
        };
        let observation = self.observations.get(index).filter(|observation| own(observation))?;
        let before = self.observations[..index]
            .iter()
            .filter(|other| own(other) && other.quantity == observation.quantity)
            .count();
        let asked = self.scene.mechanism.asked.iter().zip(&self.keyed);
        let same: Vec<&Tolerated> = asked
            .filter(|(asked, _)| Some(asked.quantity) == observation.quantity)
            .map(|(_, tolerated)| tolerated)
            .collect();
        let tolerated = same.get(before).or(same.last())?;
        Some(tolerated.allowed?.into())
    }

    /// By how much an answer may be off what follows from an earlier fault: the same part of it as of what is right.
    pub(super) fn most(&self, index: usize, seen: &[f64]) -> Room {
        let observation = &self.observations[index];
        let free = Room { by: f64::INFINITY, turn: f64::INFINITY };
        if observation.stated.is_some_and(|stated| stated > 0.0) || is_place(observation) {
            return free;
        }
        let most = match (observation.target, observation.quantity) {
            (Target::Asked(_), Some(quantity)) => {
                let [by, turn] = self.ground.most(&quantity, seen);
                Room { by: by + self.rounding(observation, size(seen)), turn }
            }
            _ => {
                let least = tolerance::FINEST * self.hand.length * self.si_of_answer(observation);
                let part = self.ground.standard().max_tolerance * size(seen);
                Room::of(least.max(part + self.rounding(observation, size(seen))))
            }
        };
        // What a reading may be off of a large vector is all of a small one: no larger part of the value is allowed than
        // of the right one.
        let usual = self.accepted(index).by;
        let Some(right) = self.right_size(index).filter(|right| *right > usual) else { return most };
        let part = self.ground.standard().max_tolerance.max(usual / right);
        let by = most.by.min(part * size(seen) + self.rounding(observation, size(seen)));
        Room { by: by.max(ROUNDING * right), ..most }
    }

    /// What was rounded in writing down a length or a place of the drawing.
    fn rounding(&self, observation: &Observation, exact: f64) -> f64 {
        let written = if observation.on_paper { observation.rounding.min(ROUNDED * exact) } else { 0.0 };
        written + ROUNDING * exact
    }

    fn allowed(&self, observation: &Observation, slip: Slip, factor: f64, seen: Option<&[f64]>) -> Allowance {
        // No part of its size is allowed of what is not seen: it is not checked.
        let exact = seen.map_or(0.0, size);
        let same = |room: Room, basis| Allowance {
            room,
            free: room,
            honest: room,
            basis,
            loose: false,
            over_cap: false,
        };
        // A part of nothing is no tolerance.
        if let Some(stated) = observation.stated.filter(|stated| *stated > 0.0) {
            let turn = if exact > stated { libm::asin(stated / exact) } else { PI };
            let turn = if self.has_direction(observation) { turn } else { f64::INFINITY };
            return same(Room { by: stated, turn }, Basis::Stated);
        }
        let rounding = self.rounding(observation, exact);
        if let (Target::Asked(_), Some(quantity)) = (observation.target, observation.quantity) {
            let value = seen.unwrap_or(&[]);
            let slips = Slips { most: slip, worst: slip };
            let unit = observation.unit.si;
            let mut allowed: Allowance = match observation.on_paper || factor != 1.0 {
                true => self.ground.read(&quantity, value, unit, slips, factor).into(),
                false => self.ground.allowed(&quantity, value, unit, slips).into(),
            };
            allowed.room.by += rounding;
            allowed.free.by += rounding;
            return allowed;
        }
        // A mark of the drawing, one reading more than the drawing itself.
        let reading = self.hand.length * self.si_of_answer(observation) * factor;
        let honest = (tolerance::SAFETY * slip.whole + reading + rounding).max(f64::MIN_POSITIVE);
        let cap = self.ground.standard().max_tolerance * exact + rounding;
        let by = match is_place(observation) {
            // A place is counted from an origin that nobody reads it from.
            true => honest,
            false => honest.min(cap.max(tolerance::FINEST * reading)),
        };
        let loose = by < honest;
        let honest = Room::of(honest);
        Allowance { room: Room::of(by), free: honest, honest, basis: Basis::Read, loose, over_cap: false }
    }

    /// The points of the skeleton that were handed in wrongly, metres.
    pub(super) fn misplaced(&self) -> Vec<(PointId, [f64; 2])> {
        let wrong = |index: usize| self.miss(index, self.truth[index].as_deref(), self.rooms[index]) > 1.0;
        let all = self.observations.iter().enumerate();
        all.filter_map(|(index, observation)| place_given(observation).filter(|_| wrong(index))).collect()
    }

    /// Where the student has a point of the skeleton, metres.
    pub(super) fn drawn_place(&self, point: PointId) -> Option<[f64; 2]> {
        self.observations.iter().filter_map(place_given).find(|(of, _)| *of == point).map(|(_, at)| at)
    }

    /// Whether a rotation has the right size and the other sense.
    pub(super) fn opposite(&self, index: usize) -> bool {
        let Given::Signed(given) = self.observations[index].given else { return false };
        match self.truth[index].as_deref() {
            Some(&[right]) => (given + right).abs() <= self.accepted(index).by,
            _ => false,
        }
    }

    /// Whether an answer is a vector with a magnitude and a direction of its own.
    fn has_direction(&self, observation: &Observation) -> bool {
        let vector = |quantity: &Quantity| is_vector(quantity) && !tolerance::is_place(quantity);
        matches!(observation.target, Target::Asked(_)) && observation.quantity.as_ref().is_some_and(vector)
    }

    /// The right ω of every link of which one was answered, rad/s.
    pub(super) fn rates_answered(&self) -> Vec<(LinkId, f64)> {
        let right = |(observation, truth): (&Observation, &Option<Vec<f64>>)| match (
            observation.quantity,
            truth.as_deref(),
        ) {
            (Some(Quantity::Omega(link)), Some(&[omega])) => Some((link, omega)),
            _ => None,
        };
        self.observations.iter().zip(&self.truth).filter_map(right).collect()
    }

    /// Whether a wrong answer is the right number in two figures.
    pub(super) fn is_rounded(&self, quantity: &Quantity) -> bool {
        self.observations.iter().enumerate().any(|(index, observation)| {
            let Some(truth) =
                self.truth[index].as_deref().filter(|_| observation.quantity == Some(*quantity))
            else {
                return false;
            };
            let [by, _] = self.misses(index, Some(&rounded(observation, truth)));
            let components = observation.form == Form::Components || truth.len() == 1;
            let whole = self.miss(index, Some(truth), self.accepted(index)) > 1.0;
            whole
                && !observation.on_paper
                && by <= ROUNDING_OFF * size(truth)
                && (components || by < size(truth))
        })
    }

    /// The part of its value that an answer may usually be off.
    pub(super) fn cap(&self) -> f64 {
        self.ground.standard().max_tolerance
    }

    /// By how much an answer may be off without costing its marks: what no careful hand can hold to the cap is not held to
    /// it, for whoever asks was told.
    pub(super) fn accepted(&self, index: usize) -> Room {
        let allowance = self.allowances[index];
        // A cap that is stricter than the usual one is meant as it is stated.
        let usual = self.ground.standard().max_tolerance >= tolerance::MAX_TOLERANCE;
        if allowance.loose && usual { allowance.free.or(allowance.room) } else { allowance.room }
    }

    /// Whether an answer that meets these numbers proves something: they are clear of nothing, or it is as near as a part of
    /// them; what is a place or an angle is counted from an origin of no meaning.
    pub(super) fn tells(&self, index: usize, numbers: &[f64], room: Room) -> bool {
        let length = size(numbers);
        if self.has_no_origin(index) || length > room.by {
            return true;
        }
        // What is no more than the slip of a hand is met by calculation, not by reading.
        self.meets(index, numbers)
    }

    /// Whether an answer is as near to numbers as a part of them, in magnitude.
    pub(super) fn meets(&self, index: usize, numbers: &[f64]) -> bool {
        let length = size(numbers);
        let part = Room::of(self.ground.standard().max_tolerance * length);
        length > 0.0 && self.miss(index, Some(numbers), part) <= 1.0
    }

    /// How large an answer is, SI.
    pub(super) fn given_size(&self, index: usize) -> f64 {
        match self.observations[index].given {
            Given::Magnitude(given) | Given::Drawn(given) | Given::Signed(given) => given.abs(),
            Given::Vector(given) => size(&given),
        }
    }

    /// Whether an answer is zero.
    pub(super) fn is_zero(&self, index: usize) -> bool {
        self.given_size(index) == 0.0
    }

    /// Whether zero means nothing for an answer: a place or an angle, or what is left when something is taken off.
    fn has_no_origin(&self, index: usize) -> bool {
        let observation = &self.observations[index];
        let rest = Quantity::Cycle(CycleQuantity::Flywheel);
        is_place(observation) || observation.quantity == Some(rest)
    }

    /// Whether a place and all others that are handed in beside it are one, or it alone is the origin, as far as may be told: of
    /// such no unit and no scale tells anything.
    pub(super) fn is_one_place(&self, index: usize) -> bool {
        let given = |index: usize| match self.observations[index].given {
            Given::Vector(at) if is_place(&self.observations[index]) => Some(at),
            _ => None,
        };
        let Some([x, y]) = given(index) else { return false };
        let room = self.rooms[index].by;
        let others = (0..self.observations.len()).filter(|&other| other != index).filter_map(given);
        let others: Vec<[f64; 2]> = others.collect();
        let near = |[u, v]: &[f64; 2]| libm::hypot(u - x, v - y) <= room;
        if others.is_empty() { near(&[0.0; 2]) } else { others.iter().all(near) }
    }

    /// Whether an answer is nothing for the hand where the right one is not.
    pub(super) fn hands_in_nothing(&self, index: usize) -> bool {
        let given = self.given_size(index);
        let nothing = |length: f64| length <= self.rooms[index].by;
        let right_is_something = self.right_size(index).is_some_and(|right| !nothing(right));
        !self.has_no_origin(index) && nothing(given) && right_is_something
    }

    /// How far an answer is from what would be seen, in rooms.
    pub(super) fn miss(&self, index: usize, seen: Option<&[f64]>, room: Room) -> f64 {
        let [by, turn] = self.misses(index, seen);
        (by / room.by).max(if room.turn.is_finite() { turn / room.turn } else { 0.0 })
    }

    /// How far an answer is from what would be seen: as a number or a magnitude, SI, and as a direction, radians.
    pub(super) fn misses(&self, index: usize, seen: Option<&[f64]>) -> [f64; 2] {
        let observation = &self.observations[index];
        let Some(seen) = seen else { return [f64::INFINITY; 2] };
        let apart = |given: &[f64]| match given.len() == seen.len() {
            true => Slip::between(given, seen, self.turns(index)).whole,
            false => f64::INFINITY,
        };
        match (observation.given, seen) {
            (Given::Magnitude(given) | Given::Drawn(given), _) => [(given - size(seen)).abs(), 0.0],
            (Given::Signed(given), _) => [apart(&[given]), 0.0],
            (Given::Vector(given), &[x, y]) if self.has_direction(observation) => {
                let slip = Slip::between(&given, &[x, y], false);
                // What would be nothing, but for its last bits, points nowhere.
                let nothing = self.right_size(index).is_some_and(|right| size(seen) <= NOISE * right);
                [slip.size, if nothing { 0.0 } else { slip.turn }]
            }
            // Each coordinate of a place for itself.
            (Given::Vector(given), &[x, y]) if matches!(observation.target, Target::Asked(_)) => {
                [(given[0] - x).abs().max((given[1] - y).abs()), 0.0]
            }
            (Given::Vector(given), _) => [apart(&given), 0.0],
        }
    }
}

/// Numbers of an answer as they are in two figures of its unit: the magnitude of what has a direction, each component, or
/// the number itself.
fn rounded(observation: &Observation, numbers: &[f64]) -> Vec<f64> {
    let si = observation.unit.si;
    let two_figures = |number: f64| {
        let own = number / si;
        if own == 0.0 || !own.is_finite() {
            return number;
        }
        let place = libm::pow(10.0, libm::floor(libm::log10(own.abs())) - 1.0);
        libm::round(own / place) * place * si
    };
    match (observation.form, numbers) {
        (Form::Components, _) | (_, [_]) => numbers.iter().map(|number| two_figures(*number)).collect(),
        _ => {
            let length = size(numbers);
            let factor = if length > 0.0 { two_figures(length) / length } else { 1.0 };
            numbers.iter().map(|number| factor * number).collect()
        }
    }
}

/// A point of the skeleton with the place that was handed in, metres.
fn place_given(observation: &Observation) -> Option<(PointId, [f64; 2])> {
    match (observation.target, observation.quantity, observation.given) {
        (Target::Place(point), _, Given::Vector(at))
        | (_, Some(Quantity::Position(point)), Given::Vector(at)) => Some((point, at)),
        _ => None,
    }
}

/// What the scene asks, with its tolerances at the scales of the student.
fn keyed(
    scene: &Scene,
    own: Solved,
    (scales, answers): (Scales, &Answers),
    standard: Standard,
) -> Result<Vec<Tolerated>, GradeError> {
    let of_the_sheet = scales == own.scales;
    let mut solved = match of_the_sheet {
        true => own,
        false => solve::solve(scene, Extent::WholeSkeleton, |_, _| scales)?,
    };
    let paper = crate::sheet::force_paper(scene, &solved.solution.construction);
    let force = answers.scales.force().or(paper.force);
    solved.scales = solved.scales.on(Paper { force, ..paper });
    if of_the_sheet {
        // Centres are measured where they are on the paper.
        let lengths = crate::sheet::smallest_lengths(scene, &solved.solution.construction);
        solved.scales = solved.scales.with(Dimension::Length, lengths);
    }
    Ok(tolerance::of_asked(scene, &solved, standard)?)
}

/// Behind the numbers of every balance.
const LAST: usize = 1_000_000;

/// When a number of the turning-moment diagram is found.
fn cycle_stage(of: CycleQuantity) -> usize {
    match of {
        CycleQuantity::Work => 0,
        CycleQuantity::Mean => 1,
        CycleQuantity::Power => 2,
        CycleQuantity::Crossing(k) => 3 + k as usize,
        CycleQuantity::Area(k) => LAST + k as usize,
        CycleQuantity::Level(k) => 2 * LAST + k as usize,
        CycleQuantity::Highest | CycleQuantity::AtHighest => 3 * LAST,
        CycleQuantity::Lowest | CycleQuantity::AtLowest => 3 * LAST + 1,
        CycleQuantity::Fluctuation => 3 * LAST + 2,
        CycleQuantity::OfEnergy | CycleQuantity::Inertia => 3 * LAST + 3,
        CycleQuantity::OfSpeed | CycleQuantity::Flywheel => 3 * LAST + 4,
        CycleQuantity::Most | CycleQuantity::Least | CycleQuantity::AtMost | CycleQuantity::AtLeast => {
            3 * LAST + 5
        }
    }
}

/// Newtons for a millimetre where no polygon stands on the sheet: the largest asked force is drawn so large.
fn on_a_hand(scene: &Scene, construction: &Construction) -> Option<f64> {
    let forces = scene.mechanism.asked.iter().zip(&construction.answers);
    let sizes = forces.filter_map(|(asked, reading)| match (asked.quantity, &reading.answer) {
        (Quantity::Force(force, _), Answer::Vector { value, .. }) if force.is_vector() => Some(size(value)),
        _ => None,
    });
    sizes.reduce(f64::max).filter(|largest| *largest > 0.0).map(|largest| largest / LARGEST_FORCE)
}

/// mm.
const LARGEST_FORCE: f64 = 100.0;

/// What turns with the input, kg m².
fn rotating(mechanism: &Mechanism) -> f64 {
    let Some(cycle) = &mechanism.forces.cycle else { return 0.0 };
    let g = mechanism.forces.gravity.g.value;
    let inertia = |of: RotatingInertia| match of {
        RotatingInertia::Central(inertia) => inertia.value,
        RotatingInertia::Mass(mass, radius) => mass.value * radius.value * radius.value,
        RotatingInertia::Weight(weight, radius) => weight.value / g * radius.value * radius.value,
    };
    let all = cycle.rotating.iter();
    all.map(|rotating| inertia(rotating.inertia) * rotating.ratio.value * rotating.ratio.value).sum()
}

/// Whether an answer is a place or an angle of the skeleton.
fn is_place(observation: &Observation) -> bool {
    matches!(observation.target, Target::Place(_) | Target::Line(..))
        || matches!(observation.quantity, Some(Quantity::Cycle(of)) if of.is_angle())
        || matches!(
            observation.quantity,
            Some(
                Quantity::Angle(_)
                    | Quantity::Transmission(..)
                    | Quantity::Position(_)
                    | Quantity::Centre(..)
            )
        )
}

/// The answers without the scales at which the right solution would be on no paper, or nothing that is seen, and without
/// what was measured by them; and what is said of these.
fn on_a_sheet<'a>(own: &Solved, answers: &'a Answers) -> (Cow<'a, Answers>, Vec<Unread>) {
    let (mut left, mut unread) = (Cow::Borrowed(answers), Vec::new());
    for order in [Order::Position, Order::Velocity, Order::Acceleration] {
        let dimension = order.dimension();
        let Some(stated) = answers.scales.of(dimension) else { continue };
        let places = || own.solution.construction.space.places.iter().flatten();
        let farthest = match order {
            Order::Position => {
                let side = |axis: usize| {
                    let (least, most) = places().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), at| {
                        (a.min(at[axis]), b.max(at[axis]))
                    });
                    most - least
                };
                side(0).max(side(1))
            }
            _ => polygon(&own.solution.construction, order).map_or(0.0, |diagram| {
                diagram.images.iter().map(|image| size(&image.at)).fold(0.0, f64::max)
            }),
        };
        let mm = farthest * own.scales.of(dimension) / stated;
        if mm > limits::PAPER_MM || (mm > 0.0 && mm < UNSEEN) {
            let what = format!("at this scale the right drawing would be {mm:.0e} mm large");
            let mend = "write what a millimetre of paper stands for: \"50 mm/s per mm\"";
            let why = answers.complain(answers.scales_at[dimension as usize], what, Some(mend.to_owned()));
            unread.push(Unread { name: super::answers::scale_name(order), quantity: None, why });
            unread.extend(left.to_mut().without_scale(order));
        }
    }
    (left, unread)
}

/// Nobody sees a drawing that is smaller (mm).
const UNSEEN: f64 = 1e-6;

/// What is shorter than this on paper (mm) does not tell a scale.
const MEASURED: f64 = 4.0;
/// Lengths that are too long by factors that differ by no more than this part are of one scale.
pub(super) const ONE_SCALE: f64 = 0.04;

/// Whether something is as many times too long as another.
fn is_of_scale(own: f64, factor: f64) -> bool {
    (own / factor - 1.0).abs() <= ONE_SCALE
}

/// How many times too long lengths of one polygon are: as long as two of them say so and but a few do not, and not as many
/// are as they should be.
fn of_lengths(mut times: Vec<f64>) -> Option<f64> {
    times.sort_by(f64::total_cmp);
    let factor = *times.get(times.len() / 2)?;
    let alike = |factor: f64| move |own: &&f64| is_of_scale(**own, factor);
    let agreeing: Vec<f64> = times.iter().filter(alike(factor)).copied().collect();
    let at_the_sheets = times.iter().filter(alike(1.0)).count();
    let is_own = factor > 0.0
        && agreeing.len() >= 2
        && 3 * agreeing.len() >= 2 * times.len()
        && agreeing.len() > at_the_sheets;
    #[expect(clippy::cast_precision_loss, reason = "answers are few")]
    let mean = agreeing.iter().sum::<f64>() / agreeing.len().max(1) as f64;
    is_own.then_some(mean)
}

/// How many times too fast an input becomes whose unit is taken for another: polygons that are larger by such a factor and
/// by its square tell that, and no scale.
fn mixed_rates() -> impl Iterator<Item = f64> {
    [30.0 / PI, 2.0 * PI, 60.0, 180.0 / PI].into_iter().flat_map(|factor| [factor, 1.0 / factor])
}

/// Two points of the right solution that lie nearer to each other (mm) may have one mark.
const ONE_POINT: f64 = 1.0;

/// A fixed point that stands farther from its place than this (mm) is drawn elsewhere.
const ELSEWHERE: f64 = 1.2;

/// A tolerance that is not wider than this, against that of the right drawing, is the same.
pub(super) const WIDE: f64 = 2.0;
/// A number of which more than this part is open tells nothing.
const TELLS: f64 = 0.5;
/// What a student rounds away at most, as a part of the value.
const ROUNDED: f64 = 0.01;
/// Beside what is right a number that is smaller than this part of it is the last bits of zero.
const NOISE: f64 = 1e-9;
/// What is lost in the conversion of units, as a part of the value.
const ROUNDING: f64 = 1e-9;
/// Two numbers in two figures that differ by less than this part are one.
const ROUNDING_OFF: f64 = 1e-6;

/// The direction of a line of the skeleton; `None` where it is not drawn.
pub(super) fn direction(construction: &Construction, of: Reference) -> Option<[f64; 2]> {
    let along = match of {
        Reference::Points(a, b) => {
            let places = &construction.space.places;
            let [a, b] = [places[a.0]?, places[b.0]?];
            [b[0] - a[0], b[1] - a[1]]
        }
        // A guide is seen by a line that is drawn along it or square to it.
        Reference::Guide(_) => {
            let mut lines = construction.diagrams.iter().flat_map(|diagram| &diagram.lines);
            lines.find_map(|line| match *line {
                ConstructionLine::Ray { from, to, claim: Some(Claim::Parallel(r)), .. } if r == of => {
                    Some([to[0] - from[0], to[1] - from[1]]).filter(|d| size(d) > LEGIBLE)
                }
                ConstructionLine::Ray { from, to, claim: Some(Claim::Perpendicular(r)), .. } if r == of => {
                    Some([to[1] - from[1], from[0] - to[0]]).filter(|d| size(d) > LEGIBLE)
                }
                _ => None,
            })?
        }
    };
    let length = size(&along);
    (length > 0.0).then(|| along.map(|x| x / length))
}

/// A line that is shorter (mm) has no direction to be seen.
const LEGIBLE: f64 = 1e-3;

/// The sine of the flattest crossing at which a pencil still finds a point.
const FLAT: f64 = 0.05;
/// So many directions at least were typed into a calculator, if what they were read off by is made so much of.
const TYPED: usize = 4;
/// Of the 6.28° between two degrees with one sine and cosine in radians a third, so that four are met by chance in 1 of 80.
const MOST_TYPED: f64 = 1.0;

/// The direction that a line claims to have.
pub(super) fn claimed(construction: &Construction, claim: Claim) -> Option<[f64; 2]> {
    match claim {
        Claim::Parallel(of) => direction(construction, of),
        Claim::Perpendicular(of) => direction(construction, of).map(|[x, y]| [-y, x]),
    }
}

/// The length of a vector, the size of a number.
pub(super) fn size(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |sum, n| libm::hypot(sum, *n))
}

/// A polygon of a construction.
pub(super) fn polygon(
    construction: &Construction,
    order: Order,
) -> Option<&crate::graphical::construction::Diagram> {
    construction.diagram(order.diagram())
}

/// A point's name without primes, commas and blanks; in polygons in small letters.
fn plain_name(name: &str, order: Order) -> String {
    let plain = name.chars().filter(|c| !is_prime(*c) && !matches!(c, ',' | '_' | ' '));
    // Indices as reports print them.
    let plain: String = plain
        .map(|c| match c {
            '₀'..='₉' => char::from_digit(c as u32 - '₀' as u32, 10).unwrap_or(c),
            _ => c,
        })
        .collect();
    if order == Order::Position { plain } else { plain.to_lowercase() }
}

/// The scene, asking for all that was answered.
fn asking(scene: &Scene, answers: &Answers) -> Scene {
    let mut asking = scene.clone();
    let asked = &mut asking.mechanism.asked;
    asked.extend(answers.items.iter().map(|item| item.asked.clone()));
    let unit = Unit { symbol: String::new(), si: 1.0 };
    for quantity in points_asked(scene, answers) {
        let (name, unit) = (String::new(), unit.clone());
        asked.push(Asked { name, quantity, unit, method: Method::Polygon });
    }
    // Values are compared, not methods: all are drawn in the polygons.
    for asked in asked {
        asked.method = Method::Polygon;
    }
    asking
}

/// What must be drawn for the points that were handed in to be there.
fn points_asked(scene: &Scene, answers: &Answers) -> Vec<Quantity> {
    let mut asked = Vec::new();
    for figure in &answers.figures {
        let mut written = HashSet::new();
        for (name, ..) in &figure.points {
            let mut name = plain_name(name, Order::Velocity);
            written.insert(name.clone());
            // The digits at the end may be those of a link.
            while name.pop().is_some_and(|c| c.is_ascii_digit()) {
                written.insert(name.clone());
            }
        }
        for (index, point) in scene.mechanism.points.iter().enumerate() {
            let id = PointId(index);
            let named = written.contains(&point.name.to_lowercase());
            let contact = scene.mechanism.contacts.contains(&id);
            if !named || contact || (scene.mechanism.is_fixed(id) && figure.order != Order::Position) {
                continue;
            }
            asked.push(match figure.order {
                Order::Position => Quantity::Position(id),
                Order::Velocity => Quantity::Velocity(id),
                Order::Acceleration => Quantity::Acceleration(id),
            });
        }
    }
    asked
}

/// Where in the order of the solution a quantity is found: in which step, and there after how many acts.
pub(super) fn rank_of(construction: &Construction, quantity: &Quantity) -> (Order, usize, usize) {
    let order = quantity.order();
    let links: &[LinkId] = match quantity {
        Quantity::RelativeOmega(i, j) | Quantity::RelativeAlpha(i, j) | Quantity::Ratio(i, j) => &[*i, *j],
        Quantity::Rub(_, i, j) | Quantity::Advantage(i, j) => &[*i, *j],
        Quantity::Omega(i) | Quantity::Alpha(i) => &[*i],
        _ => &[],
    };
    let mut found: Option<(usize, usize)> = None;
    for (number, step) in construction.steps.iter().enumerate() {
        for (place, act) in step.acts.iter().enumerate() {
            let here = match act {
                Act::ReadVector { vector, .. } | Act::LayOffVector { vector, .. } => {
                    let vectors = construction.diagram(step.diagram).map(|diagram| &diagram.vectors);
                    links.is_empty()
                        && vectors.and_then(|v| v.get(*vector)).is_some_and(|v| v.quantity == *quantity)
                }
                Act::Calculate(Calculation::Omega { link, .. }) => {
                    order == Order::Velocity && links.contains(link)
                }
                Act::Calculate(Calculation::Alpha { link, .. }) => {
                    order == Order::Acceleration && links.contains(link)
                }
                Act::MarkIntersection { point, .. }
                | Act::TransferPoint { point, .. }
                | Act::LayOffLink { to: point, .. }
                | Act::LayOffPlace { to: point, .. } => *quantity == Quantity::Position(*point),
                _ => false,
            };
            // A difference of two rates is known when the later one is.
            if here && (found.is_none() || links.len() > 1) {
                found = Some((number, place));
            }
        }
    }
    let (step, act) = found.unwrap_or((usize::MAX, 0));
    (order, step, act)
}

fn rank_of_label(construction: &Construction, order: Order, label: Label) -> (Order, usize, usize) {
    let Some(polygon) = polygon(construction, order) else { return (order, usize::MAX, 0) };
    let place = polygon.vectors.iter().position(|v| v.head == label);
    let place = place.or_else(|| polygon.vectors.iter().position(|v| v.tail == label));
    let Some(index) = place else { return (order, usize::MAX, 0) };
    // What is laid off in a step comes before the point in which its lines meet.
    let step = polygon.vectors[index].step;
    let acts = construction.steps.get(step).map_or(&[][..], |step| &step.acts);
    let act = acts.iter().position(|act| match *act {
        Act::LayOffVector { vector, .. } => vector == index,
        Act::MarkMeet { label: met, .. } => met == label,
        _ => false,
    });
    // An image by proportion is found when those from which it is divided off are.
    (order, step, act.unwrap_or(acts.len()))
}
