//! One student's answers beside the right construction: what each answer is of, in which step it is found, what
//! any changed construction would make of it, and how far off a careful hand may be.

use std::cell::{OnceCell, RefCell};
use std::collections::HashSet;
use std::f64::consts::PI;

use super::answers::{Answers, FigurePoints, Form, Given, StatedScales, Tolerance, is_vector};
use super::change::{Change, InputChange, Misreading, Stray, Which};
use super::{GradeError, GradeSettings};
use crate::board::Hand;
use crate::graphical::construction::{
    Act, Calculation, Claim, Construction, ConstructionLine, ForceSheet, Label, Reference,
};
use crate::graphical::cycle::CycleSheet;
use crate::graphical::{Departure, Paper, Scales, Sketch, free_bodies, sketch};
use crate::limits;
use crate::mechanism::cycle::{CycleQuantity, RotatingInertia};
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Answer, Asked, Method, Order, Quantity, Unit};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Input, LinkId, Mechanism, PointId};
use crate::plan::{Extent, Plan};
use crate::scene::Scene;
use crate::sheet::HandedIn;
use crate::solve::{self, Solved};

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
    /// The right drawing.
    pub(super) right: Sketch,
    pub(super) observations: Vec<Observation>,
    /// Of each answer, what is right.
    pub(super) truth: Vec<Option<Vec<f64>>>,
    /// Of each answer, by how much it may be off.
    pub(super) tolerances: Vec<f64>,
    /// Of each answer, how that was found.
    pub(super) allowances: Vec<Allowance>,
    /// Of each answer, how many times more a miss of its length counts than one of its direction.
    stiffness: Vec<f64>,
    /// The free bodies of the right solution, where forces are asked.
    sheet: Option<ForceSheet>,
    /// The right turning-moment diagram, where there is one.
    pub(super) cycle: Option<CycleSheet>,
    /// Inertia that turns in it, kg m², referred to the input.
    pub(super) rotating: f64,
    /// The largest torque of the right solution, N m.
    largest_torque: f64,
    /// The numbers of the turning-moment diagram, by what was changed of the mechanism.
    turned: RefCell<Vec<(Vec<InputChange>, Numbers)>>,
    /// By how much each of some draughtsmen is off in them.
    turned_by_hand: OnceCell<Vec<Numbers>>,
    /// No tolerance is a larger part of its value.
    max_tolerance: f64,
    /// Whether sense and direction have marks of their own.
    pub(super) by_parts: bool,
}

/// By how much an answer may be off, and why. SI.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Allowance {
    pub(super) by: f64,
    /// What it would be without a cap.
    pub(super) honest: f64,
    pub(super) basis: Basis,
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

/// What the cap needs to know of an answer.
struct Drawn {
    /// How far off the worst of the draughtsmen is.
    worst: f64,
    /// By how much a change of readings enlarges it.
    factor: f64,
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
        on_a_sheet(&own, answers)?;
        let scales =
            Scales::new(|dimension| answers.scales.of(dimension).unwrap_or(own.scales.of(dimension)));
        let asking = asking(scene, answers);
        let Solved { structure, plan, solution, .. } = solve::solve(&asking, Extent::Asked, |_, _| scales)?;
        let construction = solution.construction;
        let paper = crate::sheet::force_paper(&asking, &construction);
        let newtons = answers.scales.force().or(paper.force).or_else(|| on_a_hand(&asking, &construction));
        let scales = scales.on(Paper { force: newtons, ..paper });
        let rotating = rotating(&asking.mechanism);
        let mechanism = asking.mechanism;
        let right = sketch(&mechanism, &structure, &plan, scales, &[], None)
            .map_err(|error| GradeError::Solve(error.into()))?;
        let hand = Hand {
            length: answers.hand.0.unwrap_or(settings.hand.length),
            angle: answers.hand.1.unwrap_or(settings.hand.angle),
        };
        let mut case = Self {
            scene,
            mechanism,
            structure,
            plan,
            scales,
            stated: answers.scales,
            hand,
            draughtsmen: settings.draughtsmen,
            right,
            observations: Vec::new(),
            truth: Vec::new(),
            tolerances: Vec::new(),
            allowances: Vec::new(),
            stiffness: Vec::new(),
            largest_torque: construction.forces.as_ref().map_or(0.0, largest_torque),
            sheet: construction.forces,
            cycle: construction.cycle,
            rotating,
            turned: RefCell::default(),
            turned_by_hand: OnceCell::new(),
            max_tolerance: settings.max_tolerance,
            by_parts: settings.by_parts,
        };
        case.right = case.with_cycle(case.right.clone(), &Change::default(), None);
        case.observe_items(answers);
        for figure in &answers.figures {
            case.observe_points(answers, figure)?;
        }
        case.observations.sort_by_key(|observation| observation.rank);
        case.truth = case.seen(&case.right, &Change::default());
        for (observation, truth) in case.observations.iter_mut().zip(&case.truth) {
            let stated = answers.tolerances.iter().find(|(name, _)| *name == observation.name);
            observation.stated = stated.and_then(|(_, tolerance)| match *tolerance {
                Tolerance::Part(part) => truth.as_deref().map(|numbers| part * size(numbers)),
                Tolerance::Amount(amount) => Some(amount),
            });
        }
        case.stiffness = vec![1.0; case.observations.len()];
        case.allowances = case.allowances_of(&Change::default(), &case.truth, case.draughtsmen);
        case.tolerances = case.allowances.iter().map(|allowance| allowance.by).collect();
        for (index, observation) in case.observations.iter().enumerate() {
            let calculated = case.allowances[index].basis == Basis::Calculated;
            if let (true, Given::Vector(_), Some(truth)) = (calculated, observation.given, &case.truth[index])
            {
                let length = CALCULATED * size(truth) + observation.rounding.min(ROUNDED * size(truth));
                case.stiffness[index] = (case.tolerances[index] / length).max(1.0);
            }
        }
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
            Action::Drive(_) => 12 + 10 * bodies.len(),
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
                let by = |seed| solve::cycle_by_one_hand(&self.mechanism, self.scales, (self.hand, seed));
                let missed = |own: Numbers| {
                    own.into_iter().zip(&right).map(|(own, right)| Some(own? - (*right)?)).collect()
                };
                (0..TURNING).map(|seed| missed(by(seed))).collect()
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
        let numbers = match &mechanism.forces.cycle {
            Some(cycle) => solve::cycle_numbers(&mechanism, cycle, asked, &|_| 0.0),
            None => vec![None; asked.len()],
        };
        self.turned.borrow_mut().push((change.inputs.clone(), numbers.clone()));
        numbers
    }

    /// SI units for a millimetre of what stands for a quantity on paper.
    pub(super) fn si_of(&self, quantity: &Quantity) -> f64 {
        match (quantity, self.scales.paper().force) {
            (Quantity::Force(force, _), Some(newtons)) if force.is_vector() => newtons,
            _ => self.si_per_mm(quantity.order()),
        }
    }

    /// The same of an answer.
    pub(super) fn si_of_answer(&self, observation: &Observation) -> f64 {
        match (observation.target, &observation.quantity) {
            (Target::Image(order, _), _) => self.si_per_mm(order),
            (_, Some(quantity)) => self.si_of(quantity),
            (_, None) => self.si_per_mm(Order::Position),
        }
    }

    /// Points of a figure, from its pole; those of the skeleton from its fixed points.
    fn observe_points(&mut self, answers: &Answers, figure: &FigurePoints) -> Result<(), GradeError> {
        let order = figure.order;
        let known = self.point_names(order);
        let name_of = |order: Order| match order {
            Order::Position => "skeleton",
            Order::Velocity => "velocity",
            Order::Acceleration => "acceleration",
        };
        let mut found = Vec::new();
        for (name, at, place) in figure.points.iter().map(|(name, at, place)| (name, *at, *place)) {
            let plain = plain_name(name, order);
            let Some((_, target)) = known.iter().find(|(known, _)| *known == plain) else {
                let figure = name_of(order);
                let what = format!("the {figure} figure of this solution has no point `{name}`");
                let mut names: Vec<&str> = known.iter().map(|(name, _)| name.as_str()).collect();
                names.dedup();
                names.truncate(16);
                let mend = format!("its points are {}", names.join(", "));
                return Err(GradeError::Answers(answers.complain(place, what, Some(mend))));
            };
            found.push((name, at, *target));
        }
        for pair in &figure.shared {
            let place = |index: usize| -> Option<[f64; 2]> {
                match found.get(index)?.2 {
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
            if !one_point {
                let [one, other] = pair.map(|index| figure.points.get(index).map_or("", |(name, ..)| name));
                let at = figure.points.get(pair[0]).map_or(0, |(.., at)| *at);
                let what = format!("`{one}` and `{other}` stand beside one mark");
                let mend = format!(
                    "give each a dot of its own, or write `{one}, {other}` in one text if they are one point"
                );
                return Err(GradeError::Answers(answers.complain(at, what, Some(mend))));
            }
        }
        let onto = self.onto_figure(order, &found).ok_or_else(|| {
            let place = figure.points.first().map_or(0, |(.., place)| *place);
            let (what, mend) = match order {
                Order::Position => ("no fixed point of the skeleton is given", "give one, or better two"),
                _ => ("the pole is missing", "give it as `o`: vectors are measured from there"),
            };
            GradeError::Answers(answers.complain(place, what, Some(mend.to_owned())))
        })?;
        let si = self.si_per_mm(order);
        for (name, at, target) in found {
            let (rank, quantity) = match target {
                Target::Image(_, Label::Pole) => continue,
                Target::Place(point) if self.mechanism.is_fixed(point) => continue,
                Target::Image(order, label) => (rank_of_label(&self.right.construction, order, label), None),
                Target::Place(point) => {
                    let quantity = Quantity::Position(point);
                    (rank_of(&self.right.construction, &quantity), None)
                }
                Target::Asked(_) | Target::Line(..) => continue,
            };
            let at = onto.right(at);
            self.observations.push(Observation {
                name: format!("{}:{name}", name_of(order)),
                target,
                quantity,
                given: Given::Vector([at[0] * si, at[1] * si]),
                on_paper: true,
                form: Form::Paper,
                unit: self.unit_of(order),
                rounding: 0.0,
                stated: None,
                rank,
            });
        }
        Ok(())
    }

    /// How a student's figure lies against the right one; `None` where nothing tells.
    fn onto_figure(&self, order: Order, found: &[(&String, [f64; 2], Target)]) -> Option<Laid> {
        if order != Order::Position {
            let (_, pole, _) = found.iter().find(|(.., t)| matches!(t, Target::Image(_, Label::Pole)))?;
            return Some(Laid { from: *pole, to: [0.0; 2], turn: 0.0 });
        }
        let places = &self.right.construction.space.places;
        let fixed: Vec<([f64; 2], [f64; 2])> = found
            .iter()
            .filter_map(|(_, at, target)| match target {
                Target::Place(point) if self.mechanism.is_fixed(*point) => Some((*at, places[point.0]?)),
                _ => None,
            })
            .collect();
        let &(from, to) = fixed.first()?;
        // Two fixed points tell how the sheet was turned; one leaves it upright.
        let turn = fixed.get(1).map_or(0.0, |&(second, there)| {
            let angle = |a: [f64; 2], b: [f64; 2]| libm::atan2(b[1] - a[1], b[0] - a[0]);
            angle(to, there) - angle(from, second)
        });
        Some(Laid { from, to, turn })
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
        for image in &polygon.images {
            let name = crate::sheet::image_name(self.scene, image.label, order.diagram());
            names.push((plain_name(&name, order), Target::Image(order, image.label)));
        }
        for (name, label) in crate::sheet::image_names(self.scene, &self.right.construction, order.diagram())
        {
            names.push((plain_name(&name, order), Target::Image(order, label)));
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

    fn unit_of(&self, order: Order) -> Unit {
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
            let sketch = sketch(&mechanism, &self.structure, &self.plan, self.scales, departures, by).ok()?;
            Some(self.with_cycle(sketch, change, draughtsman))
        };
        if change.strays.is_empty() {
            return drawn(&change.departures);
        }
        // Where a stray line leads is seen on the drawing as it is without it; the same hand draws both.
        let mut departures = change.departures.clone();
        for stray in &change.strays {
            let without = drawn(&departures)?;
            departures.push(strayed(&without.construction, stray)?);
        }
        drawn(&departures)
    }

    /// Whether anything was answered that is found in the polygon of this order.
    pub(super) fn answers(&self, order: Order) -> bool {
        self.observations.iter().any(|observation| match (observation.target, observation.quantity) {
            (Target::Image(of, _), _) => of == order,
            (_, quantity) => quantity.is_some_and(|quantity| quantity.order() == order),
        })
    }

    /// A vector of a polygon as the student handed it in; a magnitude has the direction that the drawing gives it.
    pub(super) fn handed_in(&self, index: usize, sketch: &Sketch) -> Option<HandedIn> {
        let observation = &self.observations[index];
        if let (Target::Image(order, head), Given::Vector(at)) = (observation.target, observation.given) {
            let si = self.si_per_mm(order);
            return Some(HandedIn { diagram: order.diagram(), from: [0.0; 2], to: at.map(|x| x / si), head });
        }
        let quantity = observation.quantity.filter(is_vector)?;
        let order = quantity.order();
        let vectors = &polygon(&sketch.construction, order)?.vectors;
        let vector = vectors.iter().find(|v| v.quantity == quantity)?;
        let drawn = [vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]];
        let si = self.si_per_mm(order);
        let own = match observation.given {
            Given::Vector(given) => given.map(|x| x / si),
            Given::Magnitude(given) | Given::Drawn(given) if size(&drawn) > 0.0 => {
                drawn.map(|x| x / size(&drawn) * given / si)
            }
            _ => return None,
        };
        // What would leave the sheet is not drawn.
        if size(&own) > FARTHEST {
            return None;
        }
        let to = [vector.from[0] + own[0], vector.from[1] + own[1]];
        Some(HandedIn { diagram: order.diagram(), from: vector.from, to, head: vector.head })
    }

    /// Where in a polygon an answer stands: the head of its vector, or of that from which it is calculated.
    pub(super) fn place_of(&self, index: usize, sketch: &Sketch) -> Option<(Order, [f64; 2])> {
        let observation = &self.observations[index];
        let construction = &sketch.construction;
        if let Target::Image(order, label) = observation.target {
            let image = polygon(construction, order)?.images.iter().rev().find(|i| i.label == label)?;
            return Some((order, image.at));
        }
        let quantity = observation.quantity?;
        let calculated = construction.steps.iter().flat_map(|s| &s.acts).find_map(|act| match *act {
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
        let quantity = calculated.unwrap_or(quantity);
        let order = quantity.order();
        let vector = polygon(construction, order)?.vectors.iter().find(|v| v.quantity == quantity)?;
        Some((order, vector.to))
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

    fn misread(&self, observation: &Observation, reading: Misreading, numbers: &mut [f64]) {
        if let (Target::Image(order, _), Misreading::Enlarged { order: of, factor }) =
            (observation.target, reading)
        {
            if of == order {
                numbers.iter_mut().for_each(|n| *n *= factor);
            }
            return;
        }
        let Some(quantity) = observation.quantity else { return };
        if let Misreading::InRadians { of, how } = reading {
            if of.includes(&quantity)
                && let [x, y] = numbers
            {
                let (length, angle) = (libm::hypot(*x, *y), how.spoilt(libm::atan2(*y, *x)));
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
            if of.includes(&quantity)
                && let [x, y] = numbers
            {
                [*x, *y] = if from_y { [*y, *x] } else { [*x, -*y] };
            }
            return;
        }
        let (of, twist) = match reading {
            Misreading::Twisted { of, twist } => (of, twist),
            Misreading::Unscaled { of, factor } | Misreading::Divided { of, factor } => {
                if observation.on_paper {
                    return;
                }
                // What one unit of the answer is long on paper.
                let mm = observation.unit.si / self.si_of(&quantity);
                let divided = matches!(reading, Misreading::Divided { .. });
                let factor = if divided { mm * mm * factor } else { mm * factor };
                (of, crate::graphical::Twist::scaled(factor))
            }
            Misreading::Enlarged { .. }
            | Misreading::Mirrored { .. }
            | Misreading::MeasuredFrom { .. }
            | Misreading::MeasuredTo { .. }
            | Misreading::Backwards { .. }
            | Misreading::Plus { .. }
            | Misreading::Fluctuation { .. }
            | Misreading::InRadians { .. } => return,
        };
        if !of.includes(&quantity) {
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
    pub(super) fn tolerances_of(
        &self,
        change: &Change,
        seen: &[Option<Vec<f64>>],
        draughtsmen: u64,
    ) -> Vec<f64> {
        let allowances = self.allowances_of(change, seen, draughtsmen);
        // What is not the right drawing is not asked to be drawn as closely as a cap wants it.
        allowances.iter().map(|allowance| allowance.honest).collect()
    }

    fn allowances_of(&self, change: &Change, seen: &[Option<Vec<f64>>], draughtsmen: u64) -> Vec<Allowance> {
        let mut worst = vec![0.0_f64; self.observations.len()];
        for seed in 0..draughtsmen {
            let Some(sketch) = self.drawn(change, Some(seed)) else { continue };
            for (index, (numbers, worst)) in self.seen(&sketch, change).iter().zip(&mut worst).enumerate() {
                if let (Some(numbers), Some(exact)) = (numbers, &seen[index]) {
                    *worst = worst.max(self.apart(index, numbers, exact));
                }
            }
        }
        let factors = self.enlarged(change);
        let largest = self.largest_rates();
        let allowed = |index: usize| {
            let seen = seen[index].as_deref();
            let drawn = Drawn { worst: worst[index], factor: factors[index] };
            let own = self.allowed(&self.observations[index], &drawn, seen, largest);
            // Where lines cross so flatly that the result is no number, only an exact hand would prove anything.
            match self.tolerances.get(index) {
                Some(&usual) if own.honest > WIDE * usual && own.honest > TELLS * seen.map_or(0.0, size) => {
                    Allowance { honest: usual, by: own.by.min(usual), ..own }
                }
                _ => own,
            }
        };
        (0..self.observations.len()).map(allowed).collect()
    }

    /// By how much an answer may be off what follows from an earlier fault: the same part of it as of what is right.
    pub(super) fn most(&self, index: usize, seen: &[f64]) -> f64 {
        let observation = &self.observations[index];
        if observation.stated.is_some_and(|stated| stated > 0.0) || is_place(observation) {
            return f64::INFINITY;
        }
        let exact = size(seen);
        let rounding = observation.rounding.min(ROUNDED * exact) + ROUNDING * exact;
        let least = self.finest(observation, 1.0, self.largest_rates()).unwrap_or(0.0);
        (self.max_tolerance * exact + rounding).max(least)
    }

    /// However small a value is, nobody reads it finer than this; `None` where that is not told.
    fn finest(&self, observation: &Observation, factor: f64, largest: [f64; 2]) -> Option<f64> {
        match observation.quantity {
            Some(Quantity::Omega(_) | Quantity::RelativeOmega(..)) => {
                Some(self.max_tolerance * SMALL * largest[0])
            }
            Some(Quantity::Alpha(_) | Quantity::RelativeAlpha(..)) => {
                Some(self.max_tolerance * SMALL * largest[1])
            }
            Some(Quantity::Force(Force::Offset(_) | Force::Arm(..), _)) => {
                Some(FINEST * self.hand.length * self.scales.length() * factor)
            }
            Some(Quantity::Force(force, _)) if force.turns() => {
                Some(self.max_tolerance * SMALL * self.largest_torque)
            }
            Some(quantity) if !is_vector(&quantity) => None,
            _ => Some(FINEST * self.hand.length * self.si_of_answer(observation) * factor),
        }
    }

    fn allowed(
        &self,
        observation: &Observation,
        drawn: &Drawn,
        seen: Option<&[f64]>,
        largest: [f64; 2],
    ) -> Allowance {
        // A part of nothing is no tolerance.
        if let Some(stated) = observation.stated.filter(|stated| *stated > 0.0) {
            return Allowance { by: stated, honest: stated, basis: Basis::Stated };
        }
        let exact = seen.map_or(0.0, size);
        let rounding = observation.rounding.min(ROUNDED * exact) + ROUNDING * exact;
        if !observation.on_paper && observation.quantity.is_some_and(|q| self.is_calculated(&q)) {
            let length = CALCULATED * exact + rounding;
            // Its direction is measured on the skeleton, or drawn.
            let across = match observation.given {
                Given::Vector(_) => exact * libm::sin(DIRECTION.max(3.0 * self.hand.angle)),
                _ => 0.0,
            };
            let by = libm::hypot(length, across).max(f64::MIN_POSITIVE);
            return Allowance { by, honest: by, basis: Basis::Calculated };
        }
        // One reading more than the drawing itself: the length that is handed in.
        let linear = observation.quantity.is_none_or(|q| is_vector(&q));
        let reading =
            if linear { self.hand.length * self.si_of_answer(observation) * drawn.factor } else { 0.0 };
        let honest = (SAFETY * drawn.worst + reading + rounding).max(f64::MIN_POSITIVE);
        let least = self.finest(observation, drawn.factor, largest).unwrap_or(honest);
        let by = match is_place(observation) {
            // A place is counted from an origin that nobody reads it from.
            true => honest,
            false => honest.min((self.max_tolerance * exact + rounding).max(least)),
        };
        Allowance { by, honest, basis: Basis::Read }
    }

    /// The largest ω and ε of the right solution.
    fn largest_rates(&self) -> [f64; 2] {
        let acts = self.right.construction.steps.iter().flat_map(|step| &step.acts);
        let mut largest = acts.fold([0.0_f64; 2], |[w, e], act| match *act {
            Act::Calculate(Calculation::Omega { value, .. }) => [w.max(value.abs()), e],
            Act::Calculate(Calculation::Alpha { value, .. }) => [w, e.max(value.abs())],
            _ => [w, e],
        });
        for input in &self.mechanism.inputs {
            if let Input::Angle { omega, alpha, .. } = input {
                largest = [largest[0].max(omega.value.abs()), largest[1].max(alpha.value.abs())];
            }
        }
        largest
    }

    /// Whether a quantity is calculated from what is given, and no reading is behind it.
    fn is_calculated(&self, quantity: &Quantity) -> bool {
        let driven = |link: LinkId| {
            self.mechanism.inputs.iter().any(|input| match *input {
                Input::Angle { link: of, .. } | Input::Speed { link: of, .. } => of == link,
                Input::Slide { .. } => false,
            })
        };
        if let Quantity::Omega(link) | Quantity::Alpha(link) = *quantity {
            let given = |input: &Input| matches!(*input, Input::Angle { link: of, .. } if of == link);
            return self.mechanism.inputs.iter().any(given);
        }
        let mut acts = self.right.construction.steps.iter().flat_map(|step| &step.acts);
        let measured = |[a, b]: [PointId; 2]| {
            let mut acts = self.right.construction.steps.iter().flat_map(|step| &step.acts);
            acts.any(|act| {
                matches!(*act, Act::MeasureLength { from, to, .. } if [from, to] == [a, b] || [to, from] == [a, b])
            })
        };
        acts.any(|act| match *act {
            Act::Calculate(
                Calculation::Speed { quantity: of, link, ends, .. }
                | Calculation::Tangential { quantity: of, link, ends, .. },
            ) => of == *quantity && driven(link) && !measured(ends),
            Act::Calculate(Calculation::Normal { quantity: of, ends, .. }) => {
                let whole = |link: LinkId| ends.iter().all(|p| self.mechanism.link(link).points.contains(p));
                let by_driven = self.mechanism.moving().any(|link| driven(link) && whole(link));
                of == *quantity && by_driven && !measured(ends)
            }
            _ => false,
        })
    }

    /// How far two sets of numbers of an answer are apart.
    fn apart(&self, index: usize, a: &[f64], b: &[f64]) -> f64 {
        let turns = matches!(self.observations[index].quantity, Some(Quantity::Angle(_)));
        let at_infinity = a.len() != b.len();
        if at_infinity {
            return f64::INFINITY;
        }
        a.iter().zip(b).fold(0.0, |sum, (a, b)| {
            let apart = (a - b).abs();
            libm::hypot(sum, if turns { libm::fabs(libm::remainder(apart, 2.0 * PI)) } else { apart })
        })
    }

    /// How far an answer is from what would be seen.
    pub(super) fn miss(&self, index: usize, seen: &Option<Vec<f64>>) -> f64 {
        let Some(seen) = seen else { return f64::INFINITY };
        match self.observations[index].given {
            Given::Magnitude(given) | Given::Drawn(given) => (given - size(seen)).abs(),
            Given::Signed(given) => self.apart(index, &[given], seen),
            Given::Vector(given) => {
                let off = (size(&given) - size(seen)).abs();
                self.apart(index, &given, seen).max(self.stiffness[index] * off)
            }
        }
    }
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

/// The largest torque and moment among all that is balanced.
fn largest_torque(sheet: &ForceSheet) -> f64 {
    let terms = sheet.moments.iter().flat_map(|balance| balance.terms.iter().chain([&balance.found]));
    let torques = sheet.bodies.iter().flat_map(|body| &body.torques).map(|(_, torque)| torque.abs());
    terms.map(|term| term.moment.abs()).chain(torques).fold(0.0, f64::max)
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

/// Refuses a stated scale at which the right solution would be on no paper, or nothing that is seen.
fn on_a_sheet(own: &Solved, answers: &Answers) -> Result<(), GradeError> {
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
            let at = answers.scales_at[dimension as usize];
            return Err(GradeError::Answers(answers.complain(at, what, Some(mend.to_owned()))));
        }
    }
    Ok(())
}

/// Nobody sees a drawing that is smaller (mm).
const UNSEEN: f64 = 1e-6;

/// Two points of the right solution that lie nearer to each other (mm) may have one mark.
const ONE_POINT: f64 = 1.0;

/// A vector that is longer on paper (mm) is not drawn beside the right one.
const FARTHEST: f64 = 400.0;

/// A value that is calculated from what is given may be off by this part: a calculator has more digits than a question.
const CALCULATED: f64 = 0.004;
/// A direction that is drawn or measured once is good to this, radians.
const DIRECTION: f64 = 0.0175;
/// However a tolerance is capped, so many readings off the paper are always allowed.
const FINEST: f64 = 2.0;
/// A rate that is smaller than this part of the largest one is read no finer than if it were as large as that.
const SMALL: f64 = 0.1;

/// The worst of the draughtsmen is not the worst of all.
const SAFETY: f64 = 1.3;
/// A tolerance that is not wider than this, against that of the right drawing, is the same.
pub(super) const WIDE: f64 = 2.0;
/// A number of which more than this part is open tells nothing.
const TELLS: f64 = 0.5;
/// What a student rounds away at most, as a part of the value.
const ROUNDED: f64 = 0.01;
/// What is lost in the conversion of units, as a part of the value.
const ROUNDING: f64 = 1e-9;

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

/// The direction that a line claims to have.
pub(super) fn claimed(construction: &Construction, claim: Claim) -> Option<[f64; 2]> {
    match claim {
        Claim::Parallel(of) => direction(construction, of),
        Claim::Perpendicular(of) => direction(construction, of).map(|[x, y]| [-y, x]),
    }
}

/// Where the image stands to which a stray line leads.
fn strayed(construction: &Construction, stray: &Stray) -> Option<Departure> {
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
    let along = direction(construction, stray.by)?;
    let along = if stray.square { [-along[1], along[0]] } else { along };
    let across = claimed(construction, held)?;
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
    let Label::Image { point, link: None } = label else { return None };
    let at = [from[0] + far * along[0], from[1] + far * along[1]];
    Some(Departure::Image { order: stray.order, point, at })
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
    let plain = name.chars().filter(|c| !matches!(c, '\'' | '′' | '’' | ',' | '_' | ' '));
    let plain: String = plain.collect();
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
    (order, step, act.unwrap_or(0))
}
