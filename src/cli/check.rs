//! `linkgram check`.

use std::fmt::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{Ending, Failure, arguments, print, progress};
use crate::check::{Outcome, PublishedCheck, SceneCheck};
use crate::files;
use crate::parallel;
use crate::report::{diagnose, short};
use crate::scene::Scene;
use crate::solve::{Arithmetic, Settings};

/// What is told of a scene. Of ten thousand scenes nothing else is kept.
struct Checked {
    ok: bool,
    /// Why the file is no scene.
    broken: Option<String>,
    told: Told,
}

enum Told {
    Text(String),
    Json(Value),
}

/// What is to be checked.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// Scene files, or folders of them; - for standard input
    #[arg(required = true)]
    pub(super) paths: Vec<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// Allowed deviation of published values where the scene states none
    #[arg(long, value_name = "PERCENT", default_value = "5%", allow_hyphen_values = true, value_parser = arguments::percent)]
    pub(super) tolerance: f64,
    /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
    #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = arguments::arithmetic)]
    pub(super) arith: Arithmetic,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let Job { ref paths, json: as_json, tolerance, arith } = *job;
    let settings = Settings { arithmetic: arith, ..Settings::default() };
    let scenes = files::scenes_under(paths)?;
    let checked = check_all(&scenes, as_json, tolerance, settings);
    let (count, held) = (checked.len(), checked.iter().filter(|c| c.ok).count());
    let (mut text, mut list, mut broken) = (String::new(), Vec::new(), Vec::new());
    for scene in checked {
        // A file that is no scene is bad input, told on stderr; the others are still reported.
        broken.extend(scene.broken);
        match scene.told {
            Told::Text(own) => text.push_str(&own),
            Told::Json(own) => list.push(own),
        }
    }
    if as_json {
        text = serde_json::to_string_pretty(&json!({ "scenes": list }))
            .map_err(|error| Failure(error.to_string()))?
            + "\n";
    } else {
        let _ = writeln!(text, "{held} of {count} scenes hold");
    }
    print(&text)?;
    if !broken.is_empty() {
        return Err(Failure(broken.join("\nerror: ")));
    }
    Ok(if held == count { Ending::Fine } else { Ending::DoesNotHold })
}

/// Checks on all processors; the results stay in the order of the files.
fn check_all(scenes: &[PathBuf], as_json: bool, tolerance: f64, settings: Settings) -> Vec<Checked> {
    let bar = progress(scenes.len(), "scenes");
    let checked = parallel::map(scenes, |path| {
        let checked = check_one(path, as_json, tolerance, settings);
        bar.inc(1);
        checked
    });
    bar.finish_and_clear();
    checked
}

fn check_one(path: &Path, as_json: bool, tolerance: f64, settings: Settings) -> Checked {
    let read = super::read_scene(path);
    let (file, result) = match read {
        Ok((file, scene)) => {
            let check = crate::check::check_with(&scene, tolerance, settings);
            (file, Ok((scene, check)))
        }
        Err(failure) => (files::shown(path), Err(failure.told)),
    };
    let ok = result.as_ref().is_ok_and(|(_, check)| check.ok);
    let told = if as_json {
        Told::Json(in_json(&file, ok, &result))
    } else {
        Told::Text(in_words(&file, ok, &result))
    };
    Checked { ok, broken: result.err(), told }
}

/// The scene with its check, or why the file is no scene.
type Judged = Result<(Scene, SceneCheck), String>;

fn in_words(file: &str, ok: bool, result: &Judged) -> String {
    let mut out = String::new();
    let word = if ok { "holds" } else { "FAILS" };
    let _ = match result {
        Err(message) => writeln!(out, "{file}: not a scene: {message}"),
        Ok((scene, SceneCheck { outcome: Outcome::Refused { error, .. }, .. })) => {
            writeln!(out, "{file}: {word}: refused: {}", diagnose(scene, error))
        }
        Ok((_, SceneCheck { outcome: Outcome::Solved { agreement, published }, .. })) => {
            let _ = writeln!(out, "{file}: {word}: {}", super::solve::verdict(agreement));
            for compared in &agreement.compared {
                if let Some(why) = compared.indeterminate() {
                    let _ = writeln!(out, "    {}: indeterminate: {why}", compared.asked.name);
                }
            }
            published.iter().try_for_each(|p| writeln!(out, "    {}", line(p)))
        }
    };
    out
}

/// All scenes have the same keys; where nothing was solved, nothing was compared either.
fn in_json(file: &str, ok: bool, result: &Judged) -> Value {
    let unsolved = |key: &str, why: String| {
        let agreement = json!({ "worst_ratio": 0.0, "ok": ok });
        json!({ "scene": file, "ok": ok, "agreement": agreement, "published": [], key: why })
    };
    match result {
        Err(message) => unsolved("error", message.clone()),
        Ok((scene, SceneCheck { outcome: Outcome::Refused { error, .. }, .. })) => {
            unsolved("refused", diagnose(scene, error).to_string())
        }
        Ok((_, SceneCheck { outcome: Outcome::Solved { agreement, published }, .. })) => {
            let published: Vec<Value> = published.iter().map(published_json).collect();
            json!({
                "scene": file,
                "ok": ok,
                "agreement": { "worst_ratio": agreement.worst_ratio(), "ok": agreement.ok() },
                "published": published,
            })
        }
    }
}

/// One published value: `v(B)  published 170 cm/s, computed 175.3095, -3.03 %`.
fn line(p: &PublishedCheck) -> String {
    let unit = &p.asked.unit;
    let computed = p.computed.map_or("nothing".to_owned(), |c| short(c / unit.si));
    let percent = p.percent.map_or(String::new(), |x| format!(", {x:+.2} %"));
    let verdict = match (p.ok, p.erratum) {
        (true, false) => "",
        (false, true) => "  (known erratum, found)",
        (false, false) => "  OUT OF TOLERANCE",
        (true, true) => "  LISTED AS ERRATUM BUT AGREES",
    };
    format!(
        "{}: published {} {}, computed {computed}{percent}{verdict}",
        p.asked.name,
        short(p.published / unit.si),
        unit.symbol
    )
}

fn published_json(p: &PublishedCheck) -> Value {
    json!({
        "name": p.asked.name,
        "unit": p.asked.unit.symbol,
        "published": p.published / p.asked.unit.si,
        "computed": p.computed.map(|c| c / p.asked.unit.si),
        "percent": p.percent,
        "ok": p.ok,
        "erratum": p.erratum,
    })
}
