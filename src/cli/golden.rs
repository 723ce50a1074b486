//! `linkgram golden`.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::{Ending, Failure, print, progress};
use crate::files;
use crate::golden::{GoldenError, Report, Suite, Verdict, html, junit};

/// What is to be looked at.
pub(super) struct Job {
    pub(super) folder: PathBuf,
    pub(super) names: Vec<String>,
}

pub(super) fn check(
    job: &Job,
    report: Option<&Path>,
    xml: Option<&Path>,
    as_json: bool,
) -> Result<Ending, Failure> {
    let page = |path: &&Path| path.extension().is_some_and(|ending| ending == "html");
    if let Some(path) = report.filter(|path| !page(path)) {
        return Err(Failure(format!("{}: the report is a page; end its name in .html", files::shown(path))));
    }
    let suite = job.open()?;
    let bar = progress(suite.cases().len(), "figures");
    let checked = suite.check(&|| bar.inc(1));
    bar.finish_and_clear();
    let mut all: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    all.extend(report.map(|path| (path.to_owned(), html(&checked).into_bytes())));
    all.extend(xml.map(|path| (path.to_owned(), junit(&checked).into_bytes())));
    if !all.is_empty() {
        files::write_all(&all)?;
    }
    let text = if as_json {
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

pub(super) fn bless(job: &Job) -> Result<Ending, Failure> {
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
