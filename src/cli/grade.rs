//! `linkgram grade`.

use std::path::{Path, PathBuf};

use super::{Ending, Failure, failure, print, read_scene};
use crate::files;
use crate::grade::{self, GradeError, GradeSettings};
use crate::render::{self, Format};
use crate::solve::Hand;

/// What is to be graded, and how.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) answers: PathBuf,
    pub(super) drawing: Option<PathBuf>,
    pub(super) json: bool,
    pub(super) hand: Option<Hand>,
    pub(super) output: Option<PathBuf>,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    files::spare(&job.scene, &job.output)?;
    for handed_in in [&job.answers].into_iter().chain(&job.drawing) {
        files::spare_input("what was handed in", handed_in, &job.output)?;
    }
    let standard_inputs =
        [&job.scene, &job.answers].into_iter().filter(|path| path.as_os_str() == "-").count();
    if standard_inputs > 1 {
        return Err(Failure("scene and answers cannot both be standard input".to_owned()));
    }
    let (_, scene) = read_scene(&job.scene)?;
    let (file, text) = files::read(&job.answers)?;
    let mut answers = grade::read_named(&text, &file, &scene)?;
    // Where nobody says on the command line which drawing it is, it lies beside the answers.
    let drawing = match (&job.drawing, &answers.drawing) {
        (Some(given), _) => Some(given.clone()),
        (None, Some(named)) => Some(beside(job, &answers, named)?),
        (None, None) => None,
    };
    if let Some(drawing) = drawing {
        let (file, svg) = files::read_file(&drawing)?;
        answers.add_drawing(&svg, &file, &scene)?;
    }
    if answers.is_empty() {
        return Err(Failure(format!(
            "{file}: no answers: give `values`, `lengths`, `points` or a `drawing`"
        )));
    }
    let mut settings = GradeSettings::default();
    if let Some(hand) = job.hand {
        settings.hand = hand;
    }
    let format = job.output.as_deref().map(overlay_format).transpose()?;
    let graded = grade::grade_with_overlay(&scene, &answers, &settings);
    let (report, figure) = graded.map_err(|error| match error {
        GradeError::Solve(error) => failure(&scene, &error),
        GradeError::Unconfirmed(why) => {
            Failure::unconfirmed(format!("{}: not confirmed, nothing is graded: {why}", scene.source.file()))
        }
        GradeError::Answers(diagnostic) => diagnostic.into(),
    })?;
    if let (Some(path), Some(format)) = (&job.output, format) {
        let Some(figure) = figure else {
            return Err(Failure(format!(
                "{}: no answer needs a polygon, so there is nothing to lay over",
                files::shown(path)
            )));
        };
        let bytes = render::render(&figure, format, &render::Options::default())
            .map_err(|error| Failure(error.to_string()))?;
        files::write_all(&[(path.clone(), bytes)])?;
    }
    if job.json {
        let text =
            serde_json::to_string_pretty(&report.to_json()).map_err(|error| Failure(error.to_string()))?;
        print(&(text + "\n"))?;
    } else {
        print(&report.to_text())?;
    }
    Ok(if report.holds() { Ending::Fine } else { Ending::DoesNotHold })
}

/// The place of the drawing that the answers name; told at the key that names it, where it is refused.
fn beside(job: &Job, answers: &grade::Answers, named: &str) -> Result<PathBuf, Failure> {
    files::beside_of(&job.answers, named).map_err(|error| {
        let mend = "name a file beside the answers, or give it on the command line: --drawing FILE";
        answers.complain(answers.drawing_at, error.to_string(), Some(mend.to_owned())).into()
    })
}

/// The format of the overlay, by the ending of its name.
fn overlay_format(path: &Path) -> Result<Format, Failure> {
    let ending = path.extension().and_then(|e| e.to_str()).and_then(Format::from_name);
    ending.ok_or_else(|| Failure(format!("{}: unknown format; end the name in .svg", files::shown(path))))
}
