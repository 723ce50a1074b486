//! `linkgram golden`.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{Ending, Failure, print, progress};
use crate::files;
use crate::golden::{GoldenError, Report, Suite, Verdict, html, junit};

/// What is to be done.
#[derive(Debug, clap::Subcommand)]
pub(super) enum Action {
    /// Draw every scene of a folder and tell what differs from its golden: a changed number from other
    /// content, and both from a cosmetic change
    Check(Check),
    /// Make what is drawn now the goldens
    Bless(Job),
}

/// What is to be looked at.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The folder: scenes with their goldens beside them, or goldens with a suite.json
    folder: PathBuf,
    /// Only the goldens of these names
    names: Vec<String>,
}

/// What is to be compared, and what is written of it.
#[derive(Debug, clap::Args)]
pub(super) struct Check {
    #[command(flatten)]
    job: Job,
    /// Write a page that shows expected, actual and difference: one HTML file
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write the result as JUnit's XML, for the server that runs tests
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    json: bool,
}

pub(super) fn run(action: &Action) -> Result<Ending, Failure> {
    match action {
        Action::Check(wanted) => check(wanted),
        Action::Bless(job) => bless(job),
    }
}

fn check(Check { job, report, junit: xml, json: as_json }: &Check) -> Result<Ending, Failure> {
    let page = |path: &&Path| path.extension().is_some_and(|ending| ending == "html");
    if let Some(path) = report.as_deref().filter(|path| !page(path)) {
        return Err(Failure(format!("{}: the report is a page; end its name in .html", files::shown(path))));
    }
    let suite = job.open()?;
    let bar = progress(suite.cases().len(), "figures");
    let checked = suite.check(&|| bar.inc(1));
    bar.finish_and_clear();
    let mut all: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    all.extend(report.iter().map(|path| (path.clone(), html(&checked).into_bytes())));
    all.extend(xml.iter().map(|path| (path.clone(), junit(&checked).into_bytes())));
    if !all.is_empty() {
        files::write_all(&all)?;
    }
    let text = if *as_json {
        serde_json::to_string_pretty(&told(&checked)).map_err(|error| Failure(error.to_string()))?
    } else {
        format!("{checked}{}", checked.summary())
    };
    print(&(text + "\n"))?;
    // What cannot be read is bad input, told on stderr; the others are still reported.
    let unread = checked.checked.iter().filter_map(|one| match &one.verdict {
        Verdict::Unreadable(why) | Verdict::Broken(why) => Some(why.as_str()),
        _ => None,
    });
    let unread: Vec<&str> = unread.collect();
    if !unread.is_empty() {
        return Err(Failure(unread.join("\nerror: ")));
    }
    Ok(if checked.holds() { Ending::Fine } else { Ending::DoesNotHold })
}

fn bless(job: &Job) -> Result<Ending, Failure> {
    let suite = job.open()?;
    let bar = progress(suite.cases().len(), "figures");
    let blessed = suite.bless(&|| bar.inc(1));
    bar.finish_and_clear();
    let blessed = blessed?;
    let mut text: String = blessed.iter().map(|line| format!("{line}\n")).collect();
    text.push_str(if blessed.is_empty() {
        "golden: all as blessed, nothing written\n"
    } else {
        "golden: look at what is new before you keep it\n"
    });
    print(&text)?;
    Ok(Ending::Fine)
}

impl Job {
    fn open(&self) -> Result<Suite, Failure> {
        let suite = Suite::open(&self.folder)?;
        Ok(if self.names.is_empty() { suite } else { suite.only(&self.names)? })
    }
}

impl From<GoldenError> for Failure {
    fn from(error: GoldenError) -> Self {
        match error {
            GoldenError::Unconfirmed(_) => Self::unconfirmed(error.to_string()),
            _ => Failure(error.to_string()),
        }
    }
}

fn told(report: &Report) -> Value {
    let count = report.count();
    let goldens: Vec<Value> = report
        .checked
        .iter()
        .map(|one| {
            let changes: Vec<Value> = match &one.verdict {
                Verdict::Differs(changes) => changes
                    .iter()
                    .map(|c| json!({ "weight": c.weight.name(), "tier": c.tier.name(), "what": c.what, "size_ppm": c.size }))
                    .collect(),
                _ => Vec::new(),
            };
            let why = match &one.verdict {
                Verdict::Missing(why) | Verdict::Unreadable(why) | Verdict::Broken(why) => Some(why),
                _ => None,
            };
            let mut told = json!({ "name": one.name, "verdict": one.verdict.word(), "changes": changes });
            if let Some(scene) = &one.scene {
                told["scene"] = json!(scene);
            }
            if let Some(why) = why {
                told["why"] = why.clone().into();
            }
            told
        })
        .collect();
    json!({
        "ok": report.holds(),
        "summary": report.summary(),
        "count": {
            "same": count.same, "number": count.number, "content": count.content, "cosmetic": count.cosmetic,
            "missing": count.missing, "extra": count.extra, "unreadable": count.unreadable, "broken": count.broken,
        },
        "goldens": goldens,
    })
}
