//! What is told of graded answers: as data and as JSON; `text.rs` and `page.rs` tell it to people.

use serde_json::{Value, json};

use super::answers::{Answers, Form, Given};
use super::case::{Allowance, Basis, Case, Observation, Target, size};
use super::judge::{Judgement, Mistake, Verdict};
use super::mistakes::vector_of;
use super::phrase::{Phrase, say};
use super::symbols::Symbols;
use crate::graphical::construction::Label;
use crate::mechanism::quantity::{Nature, Order, Quantity, Unit};
use crate::scene::Diagnostic;
use crate::sheet::Language;

/// A graded solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The scene's file.
    pub scene: String,
    /// Who handed it in, where that is told.
    pub student: Option<String>,
    /// Every answer, in the order of the solution.
    pub quantities: Vec<Graded>,
    /// What is asked and was not answered, with the marks that it would have brought.
    pub missing: Vec<(String, f64)>,
    /// What was handed in and is not understood: it answers nothing.
    pub not_read: Vec<NotRead>,
    /// Points given for steps; what was not answered is one of them, without a step.
    pub marks: Vec<StepMarks>,
    /// What its names are called on the sheet.
    pub symbols: Symbols,
    /// By how much the drawing lies turned on its sheet, degrees counter-clockwise; it was turned back before it was
    /// compared.
    pub turned: Option<f64>,
    /// How many times larger than at the sheet's scale the skeleton was drawn as a whole; it was compared at its own.
    pub enlarged: Option<f64>,
    /// The scales at which a polygon for which none is stated was compared, or lengths that were measured on it.
    pub scales: Vec<UnstatedScale>,
    /// Whether the answers state a `tolerance`, which did not count.
    pub tolerances_ignored: bool,
    /// The variant of the exam to which the answers belong, where that is another one.
    pub other_variant: Option<String>,
    /// In which language it is told.
    pub language: Language,
}

/// The scale at which a polygon, or lengths of it, were compared for which the student states none.
#[derive(Debug, Clone, PartialEq)]
pub struct UnstatedScale {
    /// The polygon.
    pub order: Order,
    /// What a millimetre of paper stands for, in the unit.
    pub per_mm: f64,
    /// Of the velocities or accelerations.
    pub unit: Unit,
    /// Whether the lengths agree with one another at this scale; otherwise it is the sheet's.
    pub own: bool,
}

/// A field of a hand-in that is not understood.
#[derive(Debug, Clone, PartialEq)]
pub struct NotRead {
    /// As the file names it.
    pub name: String,
    /// What is not understood of it, where, and how to mend it.
    pub why: Diagnostic,
    /// The marks that it would have brought: none where something else answers what it was for, or nobody knows.
    pub weight: f64,
}

impl NotRead {
    /// What is not understood of it and how to mend it, without its place in the file.
    pub(super) fn what_and_mend(&self) -> String {
        let mend = self.why.mend.as_deref().map_or_else(String::new, |mend| format!("; {mend}"));
        format!("{}{mend}", self.why.what)
    }
}

/// One graded answer. Numbers are in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Graded {
    /// As the answers name it; a point of the drawing with its figure (`velocity:b`).
    pub name: String,
    /// What of the scene's `find` it is, by its name there, where it is asked.
    pub find: Option<String>,
    /// What was handed in: one number, or two components.
    pub given: Vec<f64>,
    /// In which form it was written.
    pub form: Form,
    /// What one millimetre of paper is of the unit, where it is a length or a point of the drawing.
    pub per_mm: Option<f64>,
    /// Half a unit in the last place that was written; 0 where that is not told.
    pub rounding: f64,
    /// Whether only a magnitude was handed in.
    pub magnitude_only: bool,
    /// What of it is not told where only a magnitude was handed in: `direction` or `sense`.
    pub untold: Option<&'static str>,
    /// Whether the sign of the number is a sense of turning.
    pub turns: bool,
    /// What is right; empty where it is not determined.
    pub right: Vec<f64>,
    /// By how much it may be off: the number, the magnitude of a vector, each coordinate of a place.
    pub tolerance: f64,
    /// By how much the direction of a vector may be off, degrees.
    pub turn: Option<f64>,
    /// Which part of a vector is off.
    pub amiss: Amiss,
    /// It is right as far as a careful hand can tell, though off by more than its tolerance.
    pub beyond: bool,
    /// Why.
    pub allowed: Allowed,
    /// What it is worth; nothing where it is not asked, or another answer stands for what is.
    pub weight: f64,
    /// Whether it stands for something that is asked.
    pub asked: bool,
    /// Which part of its marks it has: less than all where a sense or direction is asked and not said, and where marks are
    /// given by parts that of a wrong answer which is right.
    pub share: f64,
    /// Whether it pays for an earlier fault, of which the step itself has no mark.
    pub charged: bool,
    /// By how much it is off: the number or the magnitude.
    pub off: f64,
    /// Of all these numbers.
    pub unit: Unit,
    /// The number of the step in which it is found, from 1; `None` where none draws it.
    pub step: Option<usize>,
    /// What is said of it.
    pub verdict: Verdict,
    /// For a wrong answer: the mistakes that explain it, ranked; empty where no known mistake fits.
    pub mistakes: Vec<Mistake>,
}

/// Why an answer may be off by what it may.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Allowed {
    /// The answers' file states it.
    Stated,
    /// The value is calculated from what is given alone.
    Calculated,
    /// The value is read off the drawing: so many millimetres of paper at that place, where it is a length of paper.
    Read {
        /// Millimetres.
        mm: Option<f64>,
        /// The vector's own length on paper, mm.
        of: Option<f64>,
    },
    /// The value is read off the drawing, and so small that more is allowed than the stated part of it.
    Small {
        /// What is allowed, as a part of the value.
        part: f64,
        /// The part that is stated.
        most: f64,
        /// It is small beside a reading off the paper; otherwise beside the largest of its kind.
        of_reading: bool,
    },
    /// A careful hand may be off by more than should be asked for.
    Capped {
        /// What a careful hand may be off, in the unit of the answer.
        honest: f64,
        /// The same of the direction of a vector, degrees.
        turn: Option<f64>,
    },
}

/// Which part of an answer is off by more than it may.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Amiss {
    /// The number, or the magnitude.
    pub size: bool,
    /// The direction.
    pub direction: bool,
}

/// Where the first fault shows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstFault<'r> {
    /// The number of the step, from 1.
    pub step: Option<usize>,
    /// The answer.
    pub name: &'r str,
    /// The mistakes that explain it, ranked; empty where no known mistake fits.
    pub mistakes: &'r [Mistake],
}

impl FirstFault<'_> {
    /// The answer and its likeliest mistake, in words.
    #[must_use]
    pub fn text(&self) -> Phrase {
        match self.mistakes.first() {
            None => say!("{}: no known mistake fits", self.name),
            // Most mistakes are made at the answer that shows them.
            Some(mistake) if mistake.at == self.name => mistake.text(),
            Some(mistake) => say!("{}: {}", self.name, mistake.text()),
        }
    }
}

/// Marks for the answers of one step.
#[derive(Debug, Clone, PartialEq)]
pub struct StepMarks {
    /// The number of the step, from 1; `None` for what no step draws.
    pub step: Option<usize>,
    /// The answers found in it.
    pub names: Vec<String>,
    /// Marks reached.
    pub reached: f64,
    /// Marks that could be reached.
    pub of: f64,
}

impl Verdict {
    /// Its name in a report.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Right => "right",
            Self::Consistent => "consistent",
            Self::Wrong => "wrong",
            Self::NotChecked => "not-checked",
        }
    }
}

pub(super) fn report(case: &Case<'_>, answers: &Answers, judgement: &Judgement) -> Report {
    let worth = worth(case, &judgement.verdicts);
    let charged = charged(judgement, &worth);
    let quantities: Vec<Graded> = case
        .observations
        .iter()
        .enumerate()
        .map(|(index, _)| {
            let fault = judgement.faults.iter().find(|fault| fault.first == index);
            let mistakes = fault.map(|fault| fault.mistakes.clone()).unwrap_or_default();
            let graded = graded(case, index, worth[index], judgement.verdicts[index], mistakes);
            Graded { charged: charged.contains(&index), ..graded }
        })
        .collect();
    let (missing, not_read) = unanswered(case);
    let marks = marks(&quantities, case, &missing, &not_read);
    Report {
        scene: case.scene.source.file().to_owned(),
        student: answers.student.clone(),
        quantities,
        missing,
        not_read,
        marks,
        symbols: case.symbols(),
        turned: case.turns.told(),
        enlarged: case.enlarged,
        scales: unstated_scales(case, judgement),
        tolerances_ignored: case.tolerances_ignored,
        other_variant: answers.other_variant.clone(),
        language: case.language,
    }
}

/// The scales that are told because none is stated: their own always, the sheet's where a length is wrong at it.
fn unstated_scales(case: &Case<'_>, judgement: &Judgement) -> Vec<UnstatedScale> {
    let of = |order: Order| {
        let own = case.own_scales.iter().find(|(of, _)| *of == order).map(|(_, si_per_mm)| *si_per_mm);
        let wrong = |(index, observation): (usize, &Observation)| {
            let of = match observation.target {
                Target::Image(of, _) => Some(of),
                Target::Asked(_) => observation.quantity.map(|quantity| quantity.order()),
                Target::Place(_) | Target::Line(..) => None,
            };
            observation.on_paper && of == Some(order) && judgement.verdicts[index] == Verdict::Wrong
        };
        let compared = || case.observations.iter().enumerate().any(wrong);
        let told = own.is_some() || case.stated.of(order.dimension()).is_none() && compared();
        let unit = case.unit_of(order);
        let per_mm = own.unwrap_or_else(|| case.si_per_mm(order)) / unit.si;
        told.then_some(UnstatedScale { order, per_mm, unit, own: own.is_some() })
    };
    [Order::Velocity, Order::Acceleration].into_iter().filter_map(of).collect()
}

/// The answers at which faults cost their mark that show first in what has none: each costs it at the first answer with
/// a mark that follows from it, as it would had only that been handed in.
fn charged(judgement: &Judgement, worth: &[Option<f64>]) -> Vec<usize> {
    let marked = |index: usize| worth[index].is_some_and(|worth| worth > 0.0);
    let mut charged: Vec<usize> = Vec::new();
    for (number, _) in judgement.faults.iter().enumerate().filter(|(_, fault)| !marked(fault.first)) {
        let follows = |index: &usize| judgement.caused[*index] == Some(number) && marked(*index);
        charged.extend((0..worth.len()).find(follows));
    }
    charged
}

/// What the marks of the scene say of a name; 1 where they say nothing.
fn stated(case: &Case<'_>, name: &str) -> f64 {
    let stated = case.scene.sheet.marks.iter().find(|(known, _)| *known == name);
    stated.map_or(1.0, |(_, weight)| *weight)
}

/// What each answer is worth; `None` of one that stands for nothing that is asked. What is asked is worth its marks
/// once, however often and in whatever form it is handed in: a value stands for it before a length, that before the
/// drawing.
fn worth(case: &Case<'_>, verdicts: &[Verdict]) -> Vec<Option<f64>> {
    if !case.scene.source.asks() {
        return case.observations.iter().map(|observation| Some(weight(case, observation))).collect();
    }
    let mut worth: Vec<Option<f64>> = vec![None; case.observations.len()];
    let mut give = |index: usize, marks: f64| worth[index] = Some(worth[index].unwrap_or(0.0) + marks);
    let all = &case.scene.mechanism.asked;
    for (place, asked) in all.iter().enumerate() {
        // Of what is asked twice the answers stand in the order in which it is asked.
        let before = all[..place].iter().filter(|other| other.quantity == asked.quantity).count();
        let bearers = bearers(case, verdicts, asked.quantity);
        if let Some(&index) = bearers.get(before).or(bearers.last()) {
            give(index, stated(case, &asked.name));
        }
    }
    // Whoever sets marks for what he does not ask, wants them given.
    for (name, marks) in &case.scene.sheet.marks {
        let own = case.observations.iter().position(|observation| observation.name == *name);
        if let (Some(index), false) = (own, all.iter().any(|asked| asked.name == *name)) {
            give(index, *marks);
        }
    }
    worth
}

/// The answers that stand for a quantity, in the order of the file.
fn bearers(case: &Case<'_>, verdicts: &[Verdict], quantity: Quantity) -> Vec<usize> {
    let written = |on_paper: bool| -> Vec<usize> {
        let own = |observation: &Observation| {
            matches!(observation.target, Target::Asked(_))
                && observation.quantity == Some(quantity)
                && observation.on_paper == on_paper
        };
        (0..case.observations.len()).filter(|&index| own(&case.observations[index])).collect()
    };
    let [values, lengths] = [false, true].map(written);
    match (values.is_empty(), lengths.is_empty()) {
        (false, _) => values,
        (true, false) => lengths,
        (true, true) => shown(case, verdicts, quantity).into_iter().collect(),
    }
}

/// The point of the drawing that shows a quantity: the head of its vector where the tail is drawn as well. A wrong tail
/// under a head that is right stands for it, unless it stands for a quantity of its own: it costs its mark once.
fn shown(case: &Case<'_>, verdicts: &[Verdict], quantity: Quantity) -> Option<usize> {
    let at = |target: Target| case.observations.iter().position(|observation| observation.target == target);
    let (order, point) = match quantity {
        Quantity::Position(point) => return at(Target::Place(point)),
        Quantity::Velocity(point) | Quantity::Acceleration(point) => (quantity.order(), Some(point)),
        _ => (quantity.order(), None),
    };
    if let Some(vector) = vector_of(&case.right.construction, &quantity) {
        let head = at(Target::Image(order, vector.head));
        let tail = at(Target::Image(order, vector.tail));
        match (head, tail) {
            (Some(head), None) if vector.tail == Label::Pole => return Some(head),
            (Some(head), Some(tail)) => {
                let known = |asked: &Quantity| {
                    vector_of(&case.right.construction, asked).is_some_and(|own| {
                        asked.order() == order && own.head == vector.tail && own.tail == Label::Pole
                    })
                };
                let bears = case.scene.mechanism.asked.iter().any(|asked| known(&asked.quantity));
                let alone = verdicts[tail] == Verdict::Wrong && verdicts[head] == Verdict::Right && !bears;
                return Some(if alone { tail } else { head });
            }
            _ => {}
        }
    }
    case.observations.iter().position(|observation| match observation.target {
        Target::Image(of, Label::Image { point: image, .. }) => of == order && Some(image) == point,
        _ => false,
    })
}

/// What an answer is worth where the scene asks for everything: a point of the drawing for the vector to it, unless that
/// is answered as well.
fn weight(case: &Case<'_>, observation: &Observation) -> f64 {
    let quantity = match (observation.target, observation.quantity) {
        (Target::Image(Order::Velocity, Label::Image { point, .. }), _) => Some(Quantity::Velocity(point)),
        (Target::Image(Order::Acceleration, Label::Image { point, .. }), _) => {
            Some(Quantity::Acceleration(point))
        }
        (Target::Place(_), _) => None,
        (_, quantity) => quantity,
    };
    let own = observation.quantity == quantity;
    let twice = || !own && case.observations.iter().any(|other| other.quantity == quantity);
    let Some(quantity) = quantity.filter(|_| !twice()) else { return 1.0 };
    let asked = case.scene.mechanism.asked.iter().find(|asked| asked.quantity == quantity);
    stated(case, asked.map_or(&observation.name, |asked| &asked.name))
}

/// What is asked, and neither answered nor drawn as a point; and what was handed in for it and is not understood.
fn unanswered(case: &Case<'_>) -> (Vec<(String, f64)>, Vec<NotRead>) {
    let answered = |wanted: Quantity| {
        let own = case.observations.iter().any(|observation| observation.quantity == Some(wanted));
        own || shown(case, &vec![Verdict::NotChecked; case.observations.len()], wanted).is_some()
    };
    let asked = case.scene.mechanism.asked.iter().filter(|asked| !answered(asked.quantity));
    let mut open: Vec<(Quantity, (String, f64))> =
        asked.map(|asked| (asked.quantity, (asked.name.clone(), stated(case, &asked.name)))).collect();
    let not_read = case.unread.iter().map(|unread| {
        let own = |quantity: &Quantity| Some(*quantity) == unread.quantity;
        let weight = open.iter().filter(|(quantity, _)| own(quantity)).map(|(_, (_, marks))| marks).sum();
        open.retain(|(quantity, _)| !own(quantity));
        NotRead { name: unread.name.clone(), why: unread.why.clone(), weight }
    });
    let not_read = not_read.collect();
    (open.into_iter().map(|(_, missing)| missing).collect(), not_read)
}

fn graded(
    case: &Case<'_>,
    index: usize,
    worth: Option<f64>,
    verdict: Verdict,
    mistakes: Vec<Mistake>,
) -> Graded {
    let observation = &case.observations[index];
    let si = observation.unit.si;
    let truth = case.truth[index].clone().unwrap_or_default();
    let (given, magnitude_only) = match observation.written.unwrap_or(observation.given) {
        Given::Magnitude(size) | Given::Drawn(size) => (vec![size], true),
        Given::Signed(value) => (vec![value], false),
        Given::Vector(vector) => (vector.to_vec(), false),
    };
    let right = if magnitude_only && !truth.is_empty() { vec![size(&truth)] } else { truth };
    let Allowance { room, honest, basis, loose, over_cap, .. } = case.allowances[index];
    let linear = observation.quantity.is_none_or(|q| super::answers::is_vector(&q));
    let on_paper = |amount: f64| amount / case.si_of_answer(observation);
    let degrees = |turn: f64| turn.is_finite().then(|| turn.to_degrees());
    let turn = degrees(room.turn).filter(|_| !magnitude_only);
    let allowed = match basis {
        Basis::Stated => Allowed::Stated,
        Basis::Calculated => Allowed::Calculated,
        Basis::Read if loose => Allowed::Capped {
            honest: honest.by / si,
            turn: degrees(honest.turn).filter(|_| honest.turn > room.turn && turn.is_some()),
        },
        Basis::Read if over_cap && room.by > case.cap() * size(&right) && size(&right) > 0.0 => {
            Allowed::Small { part: room.by / size(&right), most: case.cap(), of_reading: linear }
        }
        Basis::Read => Allowed::Read {
            mm: linear.then(|| on_paper(room.by)),
            of: (linear && !right.is_empty()).then(|| on_paper(size(&right))),
        },
    };
    let [off, turned] = case.misses(index, case.truth[index].as_deref());
    let accepted = case.accepted(index);
    let amiss = Amiss { size: off > accepted.by, direction: turn.is_some() && turned > accepted.turn };
    let beyond = off > room.by || turn.is_some() && turned > room.turn;
    let whole = if verdict == Verdict::Wrong { 0.0 } else { 1.0 };
    let share = match (observation.quantity, &case.truth[index]) {
        _ if !case.by_parts => whole,
        (Some(quantity), Some(truth)) if magnitude_only => {
            let of_size = crate::exam::share_without_direction(case.scene, quantity, truth);
            if amiss.size { 0.0 } else { of_size }
        }
        // What is right of a wrong answer has its part, as the key gives it.
        (Some(quantity), Some(truth)) if turn.is_some() => {
            let of_size = crate::exam::share_without_direction(case.scene, quantity, truth);
            (if amiss.size { 0.0 } else { of_size }) + if amiss.direction { 0.0 } else { 1.0 - of_size }
        }
        (Some(quantity), _) if case.opposite(index) => crate::exam::share_of_opposite(quantity),
        _ => whole,
    };
    // Whatever follows rightly is right.
    let share = match verdict {
        Verdict::Consistent if magnitude_only && case.by_parts => consistent_share(case, index),
        Verdict::Consistent => 1.0,
        _ => share,
    };
    let in_unit = |numbers: Vec<f64>| numbers.into_iter().map(|n| n / si).collect();
    let find = case.scene.mechanism.asked.iter().find(|asked| {
        let own = matches!(observation.target, Target::Asked(_));
        own && observation.quantity == Some(asked.quantity)
    });
    Graded {
        name: observation.name.clone(),
        find: find.map(|asked| asked.name.clone()),
        given: in_unit(given),
        form: observation.form,
        per_mm: observation.on_paper.then(|| case.si_of_answer(observation) / si),
        rounding: observation.rounding / si,
        magnitude_only,
        untold: observation.quantity.filter(|_| magnitude_only && !observation.on_paper).and_then(untold),
        turns: observation.quantity.is_some_and(|quantity| turns(&quantity)),
        right: in_unit(right),
        tolerance: room.by / si,
        turn,
        amiss,
        beyond: beyond && verdict == Verdict::Right,
        allowed,
        weight: worth.unwrap_or(0.0),
        asked: worth.is_some(),
        share,
        charged: false,
        off: off / si,
        unit: observation.unit.clone(),
        step: observation.rank.1.checked_add(1),
        verdict,
        mistakes,
    }
}

/// Whether the sign of a quantity is a sense of turning, and told as one.
fn turns(quantity: &Quantity) -> bool {
    quantity.nature() == Nature::Rotation
}

/// What else than a magnitude somebody may tell of a quantity.
fn untold(quantity: Quantity) -> Option<&'static str> {
    if turns(&quantity) {
        return Some("sense");
    }
    super::answers::is_vector(&quantity).then_some("direction")
}

/// Which part of its marks an answer has that follows rightly and does not say where it points.
fn consistent_share(case: &Case<'_>, index: usize) -> f64 {
    match (case.observations[index].quantity, &case.truth[index]) {
        (Some(quantity), Some(truth)) => crate::exam::share_without_direction(case.scene, quantity, truth),
        _ => 1.0,
    }
}

/// Marks by steps: what is right, or follows rightly, has its whole weight.
fn marks(
    quantities: &[Graded],
    case: &Case<'_>,
    missing: &[(String, f64)],
    not_read: &[NotRead],
) -> Vec<StepMarks> {
    let mut steps: Vec<((Order, Option<usize>), StepMarks)> = Vec::new();
    for (graded, observation) in quantities.iter().zip(&case.observations) {
        if graded.verdict == Verdict::NotChecked {
            continue;
        }
        let key = (observation.rank.0, graded.step);
        let index = steps.iter().position(|(known, _)| *known == key).unwrap_or_else(|| {
            let marks = StepMarks { step: graded.step, names: Vec::new(), reached: 0.0, of: 0.0 };
            steps.push((key, marks));
            steps.len() - 1
        });
        let marks = &mut steps[index].1;
        marks.names.push(graded.name.clone());
        marks.of += graded.weight;
        marks.reached += graded.reached();
    }
    let mut marks: Vec<StepMarks> = steps.into_iter().map(|(_, marks)| marks).collect();
    let unread = not_read.iter().filter(|one| one.weight > 0.0).map(|one| (one.name.clone(), one.weight));
    let (names, weights): (Vec<String>, Vec<f64>) = missing.iter().cloned().chain(unread).unzip();
    if !names.is_empty() {
        marks.push(StepMarks { step: None, names, reached: 0.0, of: weights.iter().sum() });
    }
    marks
}

impl Graded {
    /// Its marks: all of them where it is right or follows rightly, but for what it does not say; where they are given by
    /// parts, those of the part that is right.
    #[must_use]
    pub fn reached(&self) -> f64 {
        match self.verdict {
            _ if self.charged => 0.0,
            Verdict::Right | Verdict::Consistent | Verdict::Wrong => self.weight * self.share,
            Verdict::NotChecked => 0.0,
        }
    }
}

impl Report {
    /// Whether every answer is right or follows rightly from an earlier one.
    #[must_use]
    pub fn holds(&self) -> bool {
        !self.quantities.iter().any(|q| q.verdict == Verdict::Wrong)
    }

    /// Where the first fault shows.
    #[must_use]
    pub fn first_fault(&self) -> Option<FirstFault<'_>> {
        let first = self.quantities.iter().find(|q| q.verdict == Verdict::Wrong)?;
        Some(FirstFault { step: first.step, name: &first.name, mistakes: &first.mistakes })
    }

    /// Marks reached, and marks that could be reached.
    #[must_use]
    pub fn sum(&self) -> (f64, f64) {
        self.marks.iter().fold((0.0, 0.0), |(reached, of), step| (reached + step.reached, of + step.of))
    }

    /// The report as one JSON object.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let quantities: Vec<Value> =
            self.quantities.iter().map(|graded| self.quantity_json(graded)).collect();
        let first = self.first_fault().map(|fault| {
            json!({
                "step": fault.step, "name": fault.name,
                "mistakes": fault.mistakes.iter().map(|mistake| self.mistake_json(mistake)).collect::<Vec<_>>(),
            })
        });
        let (reached, of) = self.sum();
        let steps: Vec<Value> = self
            .marks
            .iter()
            .map(|m| json!({ "step": m.step, "names": m.names, "reached": m.reached, "of": m.of }))
            .collect();
        let mut report = json!({
            "scene": self.scene,
            "quantities": quantities,
            "missing": self.missing.iter().map(|(name, _)| name).collect::<Vec<_>>(),
            "not_read": self.not_read.iter().map(not_read_json).collect::<Vec<_>>(),
            "first_fault": first,
            "marks": { "reached": reached, "of": of, "steps": steps },
        });
        if let Some(turned) = self.turned {
            report["turned_deg"] = json!(turned);
        }
        if let Some(factor) = self.enlarged {
            report["skeleton_larger"] = json!(factor);
        }
        if !self.scales.is_empty() {
            let told = |scale: &UnstatedScale| {
                json!({ "figure": super::case::figure_name(scale.order), "per_mm": scale.per_mm,
                        "unit": scale.unit.symbol, "own": scale.own })
            };
            report["scales_not_stated"] = self.scales.iter().map(told).collect();
        }
        if self.tolerances_ignored {
            report["tolerances_ignored"] = json!(true);
        }
        if let Some(variant) = &self.other_variant {
            report["answers_of_variant"] = json!(variant);
        }
        if let Some(student) = &self.student {
            report["student"] = json!(student);
        }
        report
    }

    fn quantity_json(&self, graded: &Graded) -> Value {
        let one = |numbers: &[f64]| match numbers {
            [x] => json!(x),
            [] => Value::Null,
            numbers => json!(numbers),
        };
        let mut value = json!({
            "name": graded.name,
            "unit": graded.unit.symbol,
            "given": one(&graded.given),
            "right": one(&graded.right),
            "tolerance": graded.tolerance,
            "tolerance_because": graded.because().told(self.language),
            "measurable": !matches!(graded.allowed, Allowed::Capped { .. }),
            "marks": { "reached": graded.reached(), "of": graded.weight },
            "asked": graded.asked,
            "verdict": graded.verdict.name(),
        });
        if let Some(turn) = graded.turn {
            value["tolerance_direction_deg"] = json!(turn);
        }
        if graded.verdict == Verdict::Wrong {
            if graded.turn.is_some() {
                let parts = [("magnitude", graded.amiss.size), ("direction", graded.amiss.direction)];
                value["wrong_in"] = parts.into_iter().filter(|(_, off)| *off).map(|(part, _)| part).collect();
            }
            value["mistakes"] = graded.mistakes.iter().map(|mistake| self.mistake_json(mistake)).collect();
        }
        value
    }

    fn mistake_json(&self, mistake: &Mistake) -> Value {
        let mut value = json!({
            "kind": mistake.kind.name(), "at": &*mistake.at, "step": mistake.step,
            "residual": mistake.residual, "explains": mistake.explains, "text": self.says(&mistake.text()),
            "look": self.says(&mistake.look()),
        });
        if let Some(also) = &mistake.also {
            value["also"] = json!({
                "kind": also.kind.name(), "at": &*also.at, "step": also.step,
                "text": self.says(&also.own_text()), "look": self.says(&also.look()),
            });
        }
        value
    }
}

fn not_read_json(NotRead { name, why, weight }: &NotRead) -> Value {
    json!({
        "name": name, "file": why.file, "line": why.line, "column": why.column, "path": why.path,
        "what": why.what, "mend": why.mend, "marks": { "reached": 0.0, "of": weight },
    })
}
