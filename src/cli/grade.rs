//! `linkgram grade`.

use std::path::PathBuf;

use super::{Ending, Failure, failure, print, read_scene};
use crate::files;
use crate::grade::{self, GradeError, GradeSettings};
use crate::solve::Hand;

/// What is to be graded, and how.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) answers: PathBuf,
    pub(super) json: bool,
    pub(super) hand: Option<Hand>,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let (_, scene) = read_scene(&job.scene)?;
    let (file, text) = files::read(&job.answers)?;
    let answers = grade::read_named(&text, &file, &scene)?;
    if answers.is_empty() {
        return Err(Failure(format!("{file}: no answers: give `values`, `lengths` or `points`")));
    }
    let mut settings = GradeSettings::default();
    if let Some(hand) = job.hand {
        settings.hand = hand;
    }
    let report = grade::grade(&scene, &answers, &settings).map_err(|error| match error {
        GradeError::Solve(error) => failure(&scene, &error),
        GradeError::Answers(diagnostic) => diagnostic.into(),
    })?;
    if job.json {
        let text =
            serde_json::to_string_pretty(&report.to_json()).map_err(|error| Failure(error.to_string()))?;
        print(&(text + "\n"))?;
    } else {
        print(&report.to_text())?;
    }
    Ok(if report.holds() { Ending::Fine } else { Ending::DoesNotHold })
}
