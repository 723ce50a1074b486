//! One student's answers beside the right construction: what each answer is of, in which step it is found, what
//! any changed construction would make of it, and how far off a careful hand may be.

use std::collections::HashSet;
use std::f64::consts::PI;

use super::answers::{Answers, FigurePoints, Given, StatedScales, Tolerance, is_vector};
use super::change::{Change, Misreading, Which};
use super::{GradeError, GradeSettings};
use crate::board::Hand;
use crate::graphical::construction::{Act, Calculation, Construction, Label};
use crate::graphical::{Scales, Sketch, sketch};
use crate::mechanism::quantity::{Asked, Method, Order, Quantity, Unit};
use crate::mechanism::structure::Structure;
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::plan::{Extent, Plan};
use crate::scene::Scene;
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
        let scales = Scales {
            length: answers.scales.length.unwrap_or(own.scales.length),
            velocity: answers.scales.velocity.unwrap_or(own.scales.velocity),
            acceleration: answers.scales.acceleration.unwrap_or(own.scales.acceleration),
        };
        let asking = asking(scene, answers);
        let Solved { structure, plan, .. } = solve::solve(&asking, Extent::Asked, |_, _| scales)?;
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
        };
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
        case.tolerances = case.tolerances_of(&Change::default(), &case.truth, case.draughtsmen);
        Ok(case)
    }

    fn observe_items(&mut self, answers: &Answers) {
        let start =
            self.mechanism.asked.len() - answers.items.len() - points_asked(self.scene, answers).len();
        for (index, item) in answers.items.iter().enumerate() {
            let quantity = item.asked.quantity;
            let si_per_mm = self.si_per_mm(quantity.order());
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
                unit: item.asked.unit.clone(),
                rounding,
                stated: None,
                rank: rank_of(&self.right.construction, &quantity),
            });
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
                Target::Asked(_) => continue,
            };
            let at = onto.right(at);
            self.observations.push(Observation {
                name: format!("{}:{name}", name_of(order)),
                target,
                quantity,
                given: Given::Vector([at[0] * si, at[1] * si]),
                on_paper: true,
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
            let name = crate::sheet::image_name(self.scene, image.label, order);
            names.push((plain_name(&name, order), Target::Image(order, image.label)));
        }
        for (name, label) in crate::sheet::image_names(self.scene, &self.right.construction, order) {
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
            Which::One(quantity) if quantity.order() == Order::Velocity => self.stated.velocity.is_some(),
            Which::One(quantity) if quantity.order() == Order::Acceleration => {
                self.stated.acceleration.is_some()
            }
            _ => true,
        }
    }

    /// SI units per millimetre of a figure.
    pub(super) fn si_per_mm(&self, order: Order) -> f64 {
        match order {
            Order::Position => self.scales.length,
            Order::Velocity => self.scales.velocity,
            Order::Acceleration => self.scales.acceleration,
        }
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
        sketch(&mechanism, &self.structure, &self.plan, self.scales, &change.departures, by).ok()
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

    fn seen_of(&self, observation: &Observation, sketch: &Sketch, change: &Change) -> Option<Vec<f64>> {
        let mut numbers = match observation.target {
            Target::Asked(index) => sketch.numbers.get(index)?.clone()?,
            Target::Image(order, label) => {
                let images = &polygon(&sketch.construction, order)?.images;
                let image = images.iter().rev().find(|image| image.label == label)?;
                image.at.map(|mm| mm * self.si_per_mm(order)).to_vec()
            }
            Target::Place(point) => {
                sketch.construction.space.places[point.0]?.map(|mm| mm * self.scales.length).to_vec()
            }
        };
        for reading in &change.readings {
            match *reading {
                Misreading::MeasuredFrom { of, tail } if observation.quantity == Some(of) => {
                    let [head, tail] = self.head_and(&sketch.construction, &of, tail)?;
                    numbers = vec![head[0] - tail[0], head[1] - tail[1]];
                }
                Misreading::Backwards { of, from } if observation.quantity == Some(of) => {
                    let [head, from] = self.head_and(&sketch.construction, &of, from)?;
                    numbers = vec![2.0 * from[0] - head[0], 2.0 * from[1] - head[1]];
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
        let Some(quantity) = observation.quantity else { return };
        let (of, twist) = match reading {
            Misreading::Twisted { of, twist } => (of, twist),
            Misreading::Unscaled { of, factor } | Misreading::Divided { of, factor } => {
                if observation.on_paper {
                    return;
                }
                // What one unit of the answer is long on paper.
                let mm = observation.unit.si / self.si_per_mm(quantity.order());
                let divided = matches!(reading, Misreading::Divided { .. });
                let factor = if divided { mm * mm * factor } else { mm * factor };
                (of, crate::graphical::Twist::scaled(factor))
            }
            Misreading::MeasuredFrom { .. } | Misreading::Backwards { .. } => return,
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
        let allowed = |index: usize| {
            let seen = seen[index].as_deref();
            let own = self.allowed(&self.observations[index], worst[index], factors[index], seen);
            // Where lines cross so flatly that the result is no number, only an exact hand would prove anything.
            match self.tolerances.get(index) {
                Some(&usual) if own > WIDE * usual && own > TELLS * seen.map_or(0.0, size) => usual,
                _ => own,
            }
        };
        (0..self.observations.len()).map(allowed).collect()
    }

    fn allowed(&self, observation: &Observation, worst: f64, factor: f64, seen: Option<&[f64]>) -> f64 {
        // A part of nothing is no tolerance.
        if let Some(stated) = observation.stated.filter(|stated| *stated > 0.0) {
            return stated;
        }
        let exact = seen.map_or(0.0, size);
        // One reading more than the drawing itself: the length that is handed in.
        let order = observation.quantity.map_or(Order::Position, |q| q.order());
        let order = if let Target::Image(order, _) = observation.target { order } else { order };
        let linear = observation.quantity.is_none_or(|q| is_vector(&q));
        let reading = if linear { self.hand.length * self.si_per_mm(order) * factor } else { 0.0 };
        let rounding = observation.rounding.min(ROUNDED * exact);
        (SAFETY * worst + reading + rounding + ROUNDING * exact).max(f64::MIN_POSITIVE)
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
            Given::Vector(given) => self.apart(index, &given, seen),
        }
    }
}

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

/// The length of a vector, the size of a number.
pub(super) fn size(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |sum, n| libm::hypot(sum, *n))
}

/// A polygon of a construction.
pub(super) fn polygon(
    construction: &Construction,
    order: Order,
) -> Option<&crate::graphical::construction::Polygon> {
    match order {
        Order::Position => None,
        Order::Velocity => construction.velocity.as_ref(),
        Order::Acceleration => construction.acceleration.as_ref(),
    }
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
                    let vectors = polygon(construction, step.order).map(|p| &p.vectors);
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
    place.map_or((order, usize::MAX, 0), |index| (order, polygon.vectors[index].step, 0))
}
