//! What the program answers, held against the truth.

use linkgram::check::agreement;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::sheet::scale;
use serde_json::{Value, json};

use super::asked::{Asked, Truth};
use super::mechanism::{cross, length, minus};

/// A sweep's errors are estimates, no bounds: so many of them are allowed, as the sweep's own check allows.
const ESTIMATES: f64 = 8.0;

/// One thing that is not as it should be.
#[derive(Clone, Debug)]
pub(crate) struct Fault {
    pub(crate) kind: &'static str,
    /// The quantity, where it is one quantity's.
    pub(crate) name: Option<String>,
    pub(crate) why: String,
}

/// What became of a scene.
#[derive(Default)]
pub(crate) struct Verdict {
    pub(crate) right: usize,
    pub(crate) faults: Vec<Fault>,
}

/// How far an answer is from the truth over what it may be; `None` where it is no number of the kind.
fn ratio(answer: &Answer, asked: &Asked) -> Result<f64, String> {
    let turn = 2.0 * std::f64::consts::PI;
    let (apart, bound) = match (answer, &asked.truth) {
        (Answer::Scalar { value, bound }, Truth::Scalar(truth)) => {
            let apart = if asked.name.starts_with("rub") { value.abs() - truth } else { value - truth };
            (apart.abs(), *bound)
        }
        (Answer::Scalar { value, bound }, Truth::Angle(truth)) => {
            let apart = value - truth;
            ((apart - turn * (apart / turn).round()).abs(), *bound)
        }
        (Answer::Vector { value, bound }, Truth::Vector(truth)) => (length(minus(*value, *truth)), *bound),
        (Answer::AtInfinity { direction, bound }, Truth::AtInfinity(truth)) => {
            (cross(*direction, *truth).abs(), *bound)
        }
        (Answer::Indeterminate(why), _) => return Err(why.to_string()),
        (other, truth) => {
            return Ok(
                if matches!(truth, Truth::AtInfinity(_)) || matches!(other, Answer::AtInfinity { .. }) {
                    1e30
                } else {
                    f64::NAN
                },
            );
        }
    };
    if apart == 0.0 {
        return Ok(0.0);
    }
    if !bound.is_finite() || !apart.is_finite() {
        return Ok(f64::NAN);
    }
    Ok(apart / (bound + asked.off))
}

/// The scene with these quantities asked.
pub(crate) fn asking(scene: &Value, asked: &[Asked]) -> Value {
    let mut scene = scene.clone();
    let names: Vec<&str> = asked.iter().map(|a| a.name.as_str()).collect();
    scene["find"] = json!(names);
    scene
}

/// Runs one scene.
pub(crate) fn judge(scene: &Value, asked: &[Asked]) -> Verdict {
    let text = asking(scene, asked).to_string();
    let mut verdict = Verdict::default();
    let mut fault = |kind, name: Option<&str>, why: String| {
        verdict.faults.push(Fault { kind, name: name.map(str::to_owned), why });
    };
    let run = std::panic::catch_unwind(|| {
        let read = linkgram::scene::read(&text, "scene.json").map_err(|e| ("unreadable", e.to_string()))?;
        let solved = linkgram::solve::solve(&read, Extent::Asked, scale::for_scene)
            .map_err(|e| ("refused", e.to_string()))?;
        let analytic = linkgram::solve::solve_analytically(&read);
        let agreement = agreement(&read, &solved, &analytic);
        Ok((agreement, analytic.err().map(|e| e.to_string())))
    });
    let outcome = match run {
        Ok(outcome) => outcome,
        Err(_) => Err(("panic", "panic".to_owned())),
    };
    let (agreement, refused) = match outcome {
        Ok(both) => both,
        Err((kind, why)) => {
            fault(kind, None, why);
            return verdict;
        }
    };
    if let Some(why) = refused {
        fault("analytic refused", None, why);
    }
    if agreement.compared.len() != asked.len() {
        fault("lost", None, "not one answer for each entry".to_owned());
        return verdict;
    }
    let mut right = 0;
    for (asked, compared) in asked.iter().zip(&agreement.compared) {
        let name = Some(asked.name.as_str());
        let before = right;
        match ratio(&compared.graphical.answer, asked) {
            Err(why) => fault("graphical indeterminate", name, why),
            Ok(r) if r <= 1.0 => right += 1,
            Ok(r) => fault(
                "graphical wrong",
                name,
                format!("{:?} should be {:?} ({r:.1e})", compared.graphical.answer, asked.truth),
            ),
        }
        match ratio(&compared.analytic, asked) {
            Err(why) => {
                if agreement.refused.is_none() {
                    fault("analytic indeterminate", name, why);
                }
            }
            Ok(r) if r <= 1.0 => {}
            Ok(r) => {
                right = before;
                fault(
                    "analytic wrong",
                    name,
                    format!("{:?} should be {:?} ({r:.1e})", compared.analytic, asked.truth),
                );
            }
        }
    }
    if !agreement.ok() && verdict.faults.is_empty() {
        verdict.faults.push(Fault {
            kind: "disagree",
            name: None,
            why: format!("ratio {:e}, branch {:?}", agreement.worst_ratio(), agreement.elsewhere),
        });
    }
    verdict.right = right;
    verdict
}

/// What a sweep says wrongly of the scene's own position.
pub(crate) fn at_start(sweep: &linkgram::sweep::Sweep, asked: &[Asked]) -> Vec<String> {
    let Some(row) = sweep.at(sweep.start) else { return vec!["the start is in no stretch".to_owned()] };
    let mut complaints = Vec::new();
    for (column, found) in sweep.columns.iter().zip(&row) {
        let Some(asked) = asked.iter().find(|a| a.name == column.asked.name) else { continue };
        let Some(found) = found else {
            // A sweep draws a centre by one pair of chords, which may be parallel here.
            if asked.name.starts_with("I(") {
                continue;
            }
            complaints.push(format!("{} is not there", asked.name));
            continue;
        };
        let turn = 2.0 * std::f64::consts::PI;
        let truth = match (&asked.truth, column.axis) {
            (Truth::Scalar(truth) | Truth::Angle(truth), None) => *truth,
            (Truth::Vector(truth), Some(axis)) => truth[axis],
            _ => continue,
        };
        let mut apart = found.value - truth;
        if matches!(asked.truth, Truth::Angle(_)) {
            apart -= turn * (apart / turn).round();
        }
        if apart.abs() > asked.off + ESTIMATES * found.error {
            complaints.push(format!("{} = {} should be {truth}", column.name(), found.value));
        }
    }
    complaints
}
