//! `linkgram check`.

use std::fmt::Write;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::{Ending, Failure, print};
use crate::check::{Outcome, PublishedCheck, SceneCheck};
use crate::files;
use crate::parallel;
use crate::report::{diagnose, short};
use crate::scene::Scene;
use crate::solve::Settings;

/// Fewer scenes than this need no progress bar.
const MANY: usize = 50;

struct Checked {
    file: String,
    /// The scene with its check, or why the file is no scene.
    result: Result<(Scene, SceneCheck), String>,
}

pub(super) fn run(
    paths: &[PathBuf],
    as_json: bool,
    tolerance: f64,
    settings: Settings,
) -> Result<Ending, Failure> {
    let scenes = files::scenes_under(paths)?;
    let checked = check_all(&scenes, tolerance, settings);
    let held = checked.iter().filter(|c| c.ok()).count();
    // A file that is no scene is bad input, told on stderr; the others are still reported.
    let broken: Vec<&str> =
        checked.iter().filter_map(|c| c.result.as_ref().err().map(String::as_str)).collect();
    let text = if as_json {
        let list: Vec<Value> = checked.iter().map(Checked::json).collect();
        serde_json::to_string_pretty(&json!({ "scenes": list }))
            .map_err(|error| Failure(error.to_string()))?
            + "\n"
    } else {
        let mut out: String = checked.iter().map(Checked::text).collect();
        let _ = writeln!(out, "{held} of {} scenes hold", checked.len());
        out
    };
    print(&text)?;
    if !broken.is_empty() {
        return Err(Failure(broken.join("\nerror: ")));
    }
    Ok(if held == checked.len() { Ending::Fine } else { Ending::DoesNotHold })
}

/// Checks on all processors; the results stay in the order of the files.
fn check_all(scenes: &[PathBuf], tolerance: f64, settings: Settings) -> Vec<Checked> {
    let bar = if scenes.len() >= MANY && std::io::stderr().is_terminal() {
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} scenes, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        ProgressBar::new(scenes.len() as u64).with_style(style)
    } else {
        ProgressBar::hidden()
    };
    let checked = parallel::map(scenes, |path| {
        let checked = check_one(path, tolerance, settings);
        bar.inc(1);
        checked
    });
    bar.finish_and_clear();
    checked
}

fn check_one(path: &Path, tolerance: f64, settings: Settings) -> Checked {
    let read = super::read_scene(path);
    match read {
        Ok((file, scene)) => {
            let check = crate::check::check_with(&scene, tolerance, settings);
            Checked { file, result: Ok((scene, check)) }
        }
        Err(Failure(message)) => Checked { file: path.display().to_string(), result: Err(message) },
    }
}

impl Checked {
    fn ok(&self) -> bool {
        self.result.as_ref().is_ok_and(|(_, check)| check.ok)
    }

    fn text(&self) -> String {
        let mut out = String::new();
        let word = if self.ok() { "holds" } else { "FAILS" };
        let _ = match &self.result {
            Err(message) => writeln!(out, "{}: not a scene: {message}", self.file),
            Ok((scene, SceneCheck { outcome: Outcome::Refused { error, .. }, .. })) => {
                writeln!(out, "{}: {word}: refused: {}", self.file, diagnose(scene, error))
            }
            Ok((_, SceneCheck { outcome: Outcome::Solved { agreement, published }, .. })) => {
                let _ = writeln!(out, "{}: {word}: {}", self.file, super::solve::verdict(agreement));
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
    fn json(&self) -> Value {
        let ok = self.ok();
        let unsolved = |key: &str, why: String| {
            let agreement = json!({ "worst_ratio": 0.0, "ok": ok });
            json!({ "scene": self.file, "ok": ok, "agreement": agreement, "published": [], key: why })
        };
        match &self.result {
            Err(message) => unsolved("error", message.clone()),
            Ok((scene, SceneCheck { outcome: Outcome::Refused { error, .. }, .. })) => {
                unsolved("refused", diagnose(scene, error).to_string())
            }
            Ok((_, SceneCheck { outcome: Outcome::Solved { agreement, published }, .. })) => {
                let published: Vec<Value> = published.iter().map(published_json).collect();
                json!({
                    "scene": self.file,
                    "ok": ok,
                    "agreement": { "worst_ratio": agreement.worst_ratio(), "ok": agreement.ok() },
                    "published": published,
                })
            }
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
