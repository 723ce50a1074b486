//! What is told of graded answers: as data, as JSON and as text.

use std::fmt::Write as _;

use serde_json::{Value, json};

use super::answers::{Answers, Given};
use super::case::{Case, Observation, size};
use super::judge::{Judgement, Mistake, Verdict};
use super::kind::Kind;
use crate::mechanism::quantity::{Order, Unit};

/// A graded solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The scene's file.
    pub scene: String,
    /// Who handed it in, where that is told.
    pub student: Option<String>,
    /// Every answer, in the order of the solution.
    pub quantities: Vec<Graded>,
    /// Points given for steps.
    pub marks: Vec<StepMarks>,
}

/// One graded answer. Numbers are in its unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Graded {
    /// As the answers name it; a point of the drawing with its figure (`velocity:b`).
    pub name: String,
    /// What was handed in: one number, or two components.
    pub given: Vec<f64>,
    /// Whether only a magnitude was handed in.
    pub magnitude_only: bool,
    /// What is right; empty where it is not determined.
    pub right: Vec<f64>,
    /// By how much it may be off.
    pub tolerance: f64,
    /// By how much it is off.
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
    pub fn text(&self) -> String {
        match self.mistakes.first() {
            None => format!("{}: no known mistake fits", self.name),
            // Most mistakes are made at the answer that shows them.
            Some(mistake) if mistake.at == self.name => mistake.text(),
            Some(mistake) => format!("{}: {}", self.name, mistake.text()),
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
    let quantities: Vec<Graded> = case
        .observations
        .iter()
        .enumerate()
        .map(|(index, observation)| {
            let fault = judgement.faults.iter().find(|fault| fault.first == index);
            let mistakes = fault.map(|fault| fault.mistakes.clone()).unwrap_or_default();
            graded(case, index, observation, judgement.verdicts[index], mistakes)
        })
        .collect();
    let marks = marks(case, &quantities);
    Report { scene: case.scene.source.file().to_owned(), student: answers.student.clone(), quantities, marks }
}

fn graded(
    case: &Case<'_>,
    index: usize,
    observation: &Observation,
    verdict: Verdict,
    mistakes: Vec<Mistake>,
) -> Graded {
    let si = observation.unit.si;
    let truth = case.truth[index].clone().unwrap_or_default();
    let (given, magnitude_only) = match observation.given {
        Given::Magnitude(size) | Given::Drawn(size) => (vec![size], true),
        Given::Signed(value) => (vec![value], false),
        Given::Vector(vector) => (vector.to_vec(), false),
    };
    let right = if magnitude_only && !truth.is_empty() { vec![size(&truth)] } else { truth };
    let in_unit = |numbers: Vec<f64>| numbers.into_iter().map(|n| n / si).collect();
    Graded {
        name: observation.name.clone(),
        given: in_unit(given),
        magnitude_only,
        right: in_unit(right),
        tolerance: case.tolerances[index] / si,
        off: case.miss(index, &case.truth[index]) / si,
        unit: observation.unit.clone(),
        step: observation.rank.1.checked_add(1),
        verdict,
        mistakes,
    }
}

/// Marks by steps: what is right, or follows rightly, has its whole weight.
fn marks(case: &Case<'_>, quantities: &[Graded]) -> Vec<StepMarks> {
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
        let stated = case.scene.sheet.marks.iter().find(|(name, _)| *name == graded.name);
        let weight = stated.map_or(1.0, |(_, weight)| *weight);
        let marks = &mut steps[index].1;
        marks.names.push(graded.name.clone());
        marks.of += weight;
        if matches!(graded.verdict, Verdict::Right | Verdict::Consistent) {
            marks.reached += weight;
        }
    }
    steps.into_iter().map(|(_, marks)| marks).collect()
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
        let quantities: Vec<Value> = self.quantities.iter().map(quantity_json).collect();
        let first = self.first_fault().map(|fault| {
            json!({
                "step": fault.step, "name": fault.name,
                "mistakes": fault.mistakes.iter().map(mistake_json).collect::<Vec<_>>(),
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
            "first_fault": first,
            "marks": { "reached": reached, "of": of, "steps": steps },
        });
        if let Some(student) = &self.student {
            report["student"] = json!(student);
        }
        report
    }

    /// The report as text.
    #[must_use]
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        let rows: Vec<[String; 4]> = self.quantities.iter().map(row).collect();
        let width = |column: usize| rows.iter().map(|r| r[column].chars().count()).max().unwrap_or(0);
        let widths = [width(0), width(1), width(2)];
        for (graded, [name, given, right, verdict]) in self.quantities.iter().zip(&rows) {
            let [a, b, c] = widths;
            let _ = writeln!(text, "{name:<a$}  {given:>b$}   {right:<c$}   {verdict}");
            if graded.verdict != Verdict::Wrong {
                continue;
            }
            if graded.mistakes.is_empty() {
                let _ = writeln!(text, "    no known mistake fits");
            }
            for (place, mistake) in graded.mistakes.iter().enumerate() {
                let lead = if place == 0 { "probably" } else { "or" };
                let _ = writeln!(text, "    {lead} {}", sentence(mistake));
            }
        }
        if let Some(fault) = self.first_fault() {
            let place = fault.step.map_or(String::new(), |step| format!(" in step {step}"));
            let _ = writeln!(text, "first fault{place}, {}", fault.text());
        }
        let (reached, of) = self.sum();
        let _ = writeln!(text, "marks: {} of {}", short(reached), short(of));
        text
    }
}

fn sentence(mistake: &Mistake) -> String {
    let answers = if mistake.explains == 1 { "answer" } else { "answers" };
    format!(
        "{} (explains {} {answers}, off by {} of the tolerance)",
        mistake.text(),
        mistake.explains,
        two(mistake.residual)
    )
}

fn row(graded: &Graded) -> [String; 4] {
    let unit = &graded.unit.symbol;
    let one = |numbers: &[f64]| match numbers {
        [x, y] => format!("({}, {}) {unit}", short(*x), short(*y)),
        [x] => format!("{} {unit}", short(*x)).trim_end().to_owned(),
        _ => "-".to_owned(),
    };
    let right = match graded.right[..] {
        [] => "not determined here".to_owned(),
        _ => format!("right: {} ± {}", one(&graded.right), two(graded.tolerance)),
    };
    [graded.name.clone(), one(&graded.given), right, graded.verdict.name().to_owned()]
}

fn quantity_json(graded: &Graded) -> Value {
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
        "verdict": graded.verdict.name(),
    });
    if graded.verdict == Verdict::Wrong {
        value["mistakes"] = graded.mistakes.iter().map(mistake_json).collect();
    }
    value
}

fn mistake_json(mistake: &Mistake) -> Value {
    json!({
        "kind": mistake.kind.name(), "at": mistake.at, "step": mistake.step,
        "residual": mistake.residual, "explains": mistake.explains, "text": mistake.text(),
    })
}

impl Mistake {
    /// The mistake in words.
    #[must_use]
    pub fn text(&self) -> String {
        let at = &self.at;
        match self.kind {
            Kind::SenseReversed => format!("{at}: the opposite sense"),
            Kind::PerpendicularForParallel => {
                format!("{at}: drawn parallel instead of perpendicular, or the other way round")
            }
            Kind::NormalAwayFromCentre => format!("{at} points away from its centre"),
            Kind::NormalOfWrongLink => format!("{at} with ω, velocity, length or direction of another link"),
            Kind::CoriolisMissing => format!("{at} was left out"),
            Kind::CoriolisWithoutTwo => format!("{at} without the factor 2"),
            Kind::CoriolisWrongOmega => format!("{at} with the ω of another link"),
            Kind::CoriolisWrongTurn => format!("{at} turned the wrong way"),
            Kind::RpmAsRad => format!("{at}: revolutions per minute used as rad/s"),
            Kind::CmAsMm => format!("{at}: centimetres and millimetres mixed up"),
            Kind::InchAsFoot => format!("{at}: inches and feet mixed up"),
            Kind::ScaleForgotten => format!("{at}: the length on paper without its scale factor"),
            Kind::ScaleInverted => format!("{at}: divided by the scale factor instead of multiplied"),
            Kind::WrongAssembly => format!("{at}: the other assembly of the mechanism"),
            Kind::ImageMirrored => format!("{at} is mirrored"),
            Kind::TangentialWrongLength => format!("{at} with the length of another link or part"),
            Kind::AlphaIgnored => format!("{at}: the angular acceleration was left out"),
            Kind::AlphaSign => format!("{at}: the angular acceleration with the opposite sense"),
            Kind::RelativeReversed => format!("{at} taken the wrong way round"),
            Kind::WrongPole => format!("{at} measured from the wrong point of the polygon"),
        }
    }
}

/// Four significant digits.
fn short(x: f64) -> String {
    digits(x, 3)
}

fn two(x: f64) -> String {
    digits(x, 1)
}

fn digits(x: f64, more: usize) -> String {
    let text = format!("{x:.more$e}");
    text.parse::<f64>().map_or(text, |rounded| format!("{}", rounded + 0.0))
}
