//! `linkgram tradeoff`.

use std::fmt::Write;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::{Ending, Failure, print, read_scene};
use crate::files;
use crate::render::{Format, Lettering, Options, render};
use crate::report::diagnose;
use crate::tradeoff::{Setting, Spread, Tradeoff, Unmeasured, measure};

/// What to measure and where to write it.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// Scene files, or folders of them; - for standard input
    #[arg(required = true)]
    pub(super) paths: Vec<PathBuf>,
    /// How often everything is measured
    #[arg(long, value_name = "N", default_value_t = 21, value_parser = clap::value_parser!(u16).range(1..=10_000))]
    pub(super) passes: u16,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// A picture of error over time (.svg, .png or .pdf), besides the table on standard output
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let format = job.output.as_ref().map(|path| format_of(path)).transpose()?;
    let mut names = Vec::new();
    let mut scenes = Vec::new();
    for path in files::scenes_under(&job.paths)? {
        let (file, scene) = read_scene(&path)?;
        names.push(file);
        scenes.push(scene);
    }
    let passes = usize::from(job.passes);
    let length = (passes * Setting::all().len()) as u64;
    let bar = if std::io::stderr().is_terminal() {
        let style = ProgressStyle::with_template("{bar:40} {pos}/{len} measurements, {eta} left")
            .unwrap_or_else(|_| ProgressStyle::default_bar());
        ProgressBar::new(length).with_style(style)
    } else {
        ProgressBar::hidden()
    };
    let tradeoff = measure(&scenes, passes, crate::sheet::scale::for_scene, || bar.inc(1));
    bar.finish_and_clear();
    let left_out: Vec<(&str, String)> = tradeoff
        .left_out
        .iter()
        .map(|(index, why)| match why {
            Unmeasured::Solve(error) => {
                (names[*index].as_str(), diagnose(&scenes[*index], error).to_string())
            }
            Unmeasured::NoReference => (names[*index].as_str(), format!("{}: {why}", names[*index])),
        })
        .collect();
    if tradeoff.scenes == 0 {
        let reasons: Vec<&str> = left_out.iter().map(|(_, why)| why.as_str()).collect();
        return Err(Failure(reasons.join("\nerror: ")));
    }
    if let (Some(path), Some(format)) = (&job.output, format) {
        let figure = crate::sheet::tradeoff::of_tradeoff(&tradeoff);
        let options = Options { lettering: Lettering::Embed, ..Options::default() };
        let bytes = render(&figure, format, &options).map_err(|error| Failure(error.to_string()))?;
        files::write_all(&[(path.clone(), bytes)])?;
    }
    let text = if job.json {
        serde_json::to_string_pretty(&as_json(&tradeoff, &left_out)).map_err(|e| Failure(e.to_string()))?
            + "\n"
    } else {
        as_text(&tradeoff, &left_out, passes)
    };
    print(&text)?;
    let beyond: usize = tradeoff.outcomes.iter().map(|o| o.beyond).sum();
    Ok(if beyond == 0 { Ending::Fine } else { Ending::DoesNotHold })
}

/// The format of the picture, by the ending of its name.
fn format_of(path: &Path) -> Result<Format, Failure> {
    let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
    match Format::from_name(ending) {
        Some(format @ (Format::Svg | Format::Png | Format::Pdf)) => Ok(format),
        _ => Err(Failure(format!("{}: the picture is written as .svg, .png or .pdf", files::shown(path)))),
    }
}

/// Three significant digits of a time in microseconds.
fn micro(seconds: f64) -> String {
    let us = seconds * 1e6;
    let decimals = if us < 10.0 { 2 } else { usize::from(us < 100.0) };
    format!("{us:.decimals$}")
}

fn as_text(tradeoff: &Tradeoff, left_out: &[(&str, String)], passes: usize) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "{} scenes, {} quantities, {passes} passes; one core. Reference: the drawing in 75 digits.",
        tradeoff.scenes, tradeoff.quantities
    );
    let _ = writeln!(
        out,
        "Time: µs for a scene. Error: part of the largest asked value of the same unit in its scene.\n"
    );
    let rows = tradeoff.outcomes.iter().map(|o| {
        let time = o.seconds.map_or(["-".to_owned(), "-".to_owned()], |s| {
            [micro(s.median), format!("{} - {}", micro(s.low), micro(s.high))]
        });
        let part = |pick: fn(Spread) -> f64| o.errors.map_or("-".to_owned(), |s| format!("{:.1e}", pick(s)));
        let caution = o.caution.map_or("-".to_owned(), |s| format!("{:.0}", s.median));
        let beyond = if o.caution.is_some() { o.beyond.to_string() } else { "-".to_owned() };
        let [median, spread] = time;
        [
            o.setting.name(),
            median,
            spread,
            part(|s| s.median),
            part(|s| s.high),
            part(|s| s.most),
            caution,
            beyond,
            o.refused.to_string(),
        ]
    });
    let heading = [
        "setting",
        "time",
        "10 to 90 of 100",
        "median error",
        "90 of 100",
        "greatest",
        "bound/error",
        "beyond bound",
        "no answer",
    ]
    .map(str::to_owned);
    let rows: Vec<[String; 9]> = std::iter::once(heading).chain(rows).collect();
    let width = |c: usize| rows.iter().map(|r| r[c].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..9).map(width).collect();
    for (index, row) in rows.iter().enumerate() {
        let cells: Vec<String> = row
            .iter()
            .zip(&widths)
            .enumerate()
            .map(|(c, (text, w))| if c == 0 { format!("{text:<w$}") } else { format!("{text:>w$}") })
            .collect();
        let _ = writeln!(out, "| {} |", cells.join(" | "));
        if index == 0 {
            let lines: Vec<String> = widths.iter().map(|w| "-".repeat(w + 2)).collect();
            let _ = writeln!(out, "|{}|", lines.join("|"));
        }
    }
    for (_, why) in left_out {
        let _ = writeln!(out, "\nleft out: {why}");
    }
    out
}

fn as_json(tradeoff: &Tradeoff, left_out: &[(&str, String)]) -> Value {
    let spread = |s: Option<Spread>| {
        s.map(|s| json!({ "median": s.median, "low": s.low, "high": s.high, "greatest": s.most }))
    };
    let rows: Vec<Value> = tradeoff
        .outcomes
        .iter()
        .map(|o| {
            json!({
                "setting": o.setting.name(), "seconds": spread(o.seconds), "error": spread(o.errors),
                "bound_over_error": spread(o.caution), "beyond_bound": o.beyond, "no_answer": o.refused,
            })
        })
        .collect();
    let left_out: Vec<Value> =
        left_out.iter().map(|(file, why)| json!({ "file": file, "why": why })).collect();
    json!({
        "scenes": tradeoff.scenes, "quantities": tradeoff.quantities, "settings": rows, "left_out": left_out,
    })
}
