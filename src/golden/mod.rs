//! Golden suites: scenes with the figures that they gave when somebody looked at them, and what has changed
//! since.
//!
//! A golden is up to three files beside each other, for three tiers of comparison:
//!
//! | file | tier | what differs there |
//! |---|---|---|
//! | `NAME.figure.json` | [`Tier::Meaning`] | a number, a vector, a label: what the figure says ([`Meaning`]) |
//! | `NAME.svg` | [`Tier::Svg`] | any byte of the drawing |
//! | `NAME.png` | [`Tier::Pixels`] | what the eye sees, with a tolerance: fonts, the renderer's version |
//!
//! or, where the scene is one that must be refused (`expect`), the refusal as `NAME.refusal.txt`. The first
//! tier tells a changed number from a cosmetic change ([`Weight`]). The third needs the feature `png`.
//!
//! `NAME.scene.json` beside them is the scene as it was: where a figure changed, it tells what in the scene did, or that
//! nothing did and the program draws otherwise.
//!
//! A suite of more figures than somebody looks at keeps some of them so, and of the others one line each, in
//! [`figures.txt`](LINES): checksums of the SVG and of what each panel says. A change is then seen, in which panel, and
//! whether a number changed; how it looked before is not shown.
//!
//! A [`Suite`] is a folder: every scene in it (`*.json`, in folders below it as well), the goldens beside the
//! scenes, drawn as the scene's own `sheet` says. Where the goldens stand elsewhere, or a scene is drawn in several
//! ways, a `suite.json` in the folder says so:
//!
//! ```json
//! { "dpi": 48,
//!   "figures": [
//!     { "scenes": ["../examples"], "except": ["../examples/drafts"] },
//!     { "scenes": ["../examples/slider.json"], "as": "question", "lang": "ar", "name": "*.question.ar" } ] }
//! ```
//!
//! `scenes` lists files, and folders of them, seen from the suite, `except` those in them that are left out; `as`, `figure`, `lang`, `paper` and `theme` are the
//! options of `linkgram draw`; `"keep": "line"` keeps a line instead of files,
//! of what no entry before keeps as files; in `name`, which may begin with folders, `*` stands for the name of the scene
//! without its ending; it is `*` where nothing is said.
//!
//! A test of another crate is one line, and blesses with `LINKGRAM_BLESS=1 cargo test`:
//!
//! ```no_run
//! linkgram::golden::assert("tests/sheets", "target/golden.html");
//! ```

mod junit;
mod lines;
mod manifest;
mod meaning;
mod page;
#[cfg(feature = "png")]
pub mod pixels;
mod scene;
mod suite;
#[cfg(test)]
mod tests;

use std::fmt;
use std::path::Path;

use thiserror::Error;

pub use junit::junit;
pub use lines::LINES;
pub use manifest::{Keep, MANIFEST, ManifestError};
pub use meaning::Meaning;
pub use page::html;
pub use suite::{Case, NotDrawn, Outcome, Suite};

/// How much a change says.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// It looks otherwise and says the same.
    Cosmetic,
    /// Something else is said, and no number of what was said before changed: something came, went, or is worded
    /// otherwise.
    Content,
    /// A number changed: a value, the length or direction of a vector, the place of a point in its diagram.
    Number,
}

/// How closely a figure is looked at.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Tier {
    /// What the figure says.
    Meaning,
    /// The bytes of its SVG.
    Svg,
    /// Its picture of dots.
    Pixels,
}

/// One thing that changed.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Change {
    /// How much it says.
    pub weight: Weight,
    /// In which tier it was seen.
    pub tier: Tier,
    /// What changed, in one clause.
    pub what: String,
    /// How large the change is, in millionths of what was; 0 where it has no size.
    pub size: u64,
}

/// What became of one golden.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Verdict {
    /// As it was blessed.
    Same,
    /// Not as it was blessed: the changes, the weightiest first. Never empty.
    Differs(Vec<Change>),
    /// There is no golden, or one of its files is not there; it is named.
    Missing(String),
    /// A golden to which no scene belongs.
    Extra,
    /// A golden that cannot be read: why.
    Unreadable(String),
    /// A scene that cannot be read or drawn, and no golden says that this is right: why.
    Broken(String),
}

/// A golden that was looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Checked {
    /// The name of the golden: its path in the suite, without endings.
    pub name: String,
    /// What became of it.
    pub verdict: Verdict,
    /// What was blessed: the SVG or the refusal, where there is one and it is not as before.
    pub expected: Option<String>,
    /// What is drawn now, where it is not as before.
    pub actual: Option<String>,
    /// What changed in the scene since it was blessed, where it is not as before and the scene of then is known.
    pub scene: Option<Vec<String>>,
}

impl Checked {
    /// Why it is not as before, in one line, where that is known.
    #[must_use]
    pub fn because(&self) -> Option<String> {
        let changes = self.scene.as_ref()?;
        Some(match &changes[..] {
            // Where a file of the golden is missing or cannot be read nothing was drawn otherwise.
            [] if !matches!(self.verdict, Verdict::Differs(_)) => return None,
            [] => "the scene is as it was: the program draws it otherwise".to_owned(),
            [..] => format!("the scene changed: {}", changes.join("; ")),
        })
    }

    /// The size of its largest change.
    fn size(&self) -> (Option<Weight>, u64) {
        let sizes = match &self.verdict {
            Verdict::Differs(changes) => changes.iter().map(|change| change.size).max(),
            _ => None,
        };
        (self.verdict.weight(), sizes.unwrap_or(0))
    }
}

/// All goldens of a suite, looked at.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Each golden, in the order of the suite; those to which no scene belongs last.
    pub checked: Vec<Checked>,
}

/// How many goldens of a suite came out how.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Count {
    /// As blessed.
    pub same: usize,
    /// With a changed number.
    pub number: usize,
    /// With other content, but no changed number.
    pub content: usize,
    /// With cosmetic changes only.
    pub cosmetic: usize,
    /// Not there.
    pub missing: usize,
    /// Belonging to no scene.
    pub extra: usize,
    /// Not readable.
    pub unreadable: usize,
    /// Whose scene cannot be read or drawn.
    pub broken: usize,
}

/// Why a suite cannot be looked at, or not blessed.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum GoldenError {
    /// The suite's own file is wrong.
    #[error(transparent)]
    Manifest(#[from] ManifestError),
    /// A file cannot be read or written; it is named.
    #[error("{0}")]
    File(String),
    /// The suite is empty, or what is asked for is not in it.
    #[error("{0}")]
    Suite(String),
    /// Scenes cannot be drawn, so that nothing was blessed: one line for each.
    #[error("{}", .0.join("\nerror: "))]
    Broken(Vec<String>),
    /// The independent solver does not confirm what scenes show, so that nothing was blessed: one line for each.
    #[error("{}", .0.join("\nerror: "))]
    Unconfirmed(Vec<String>),
}

impl Weight {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cosmetic => "cosmetic",
            Self::Content => "content",
            Self::Number => "number",
        }
    }
}

impl Tier {
    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Meaning => "meaning",
            Self::Svg => "SVG",
            Self::Pixels => "pixels",
        }
    }

    /// The tiers that this build compares.
    #[must_use]
    pub const fn built() -> &'static [Self] {
        if cfg!(feature = "png") {
            &[Self::Meaning, Self::Svg, Self::Pixels]
        } else {
            &[Self::Meaning, Self::Svg]
        }
    }
}

impl Change {
    fn new(weight: Weight, what: impl Into<String>) -> Self {
        Self { weight, tier: Tier::Meaning, what: what.into(), size: 0 }
    }

    /// The same with the numbers that changed.
    fn sized(self, old: f64, new: f64) -> Self {
        let largest = old.abs().max(new.abs());
        let part = if largest > 0.0 { ((old - new).abs() / largest).min(2.0) } else { 0.0 };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most two millions")]
        let size = if part.is_finite() { libm::round(part * 1e6) as u64 } else { 0 };
        Self { size, ..self }
    }

    /// What only looks otherwise, in a later tier.
    fn looks(tier: Tier, what: impl Into<String>) -> Self {
        Self { weight: Weight::Cosmetic, tier, what: what.into(), size: 0 }
    }
}

impl Verdict {
    /// The weightiest of its changes, where it differs.
    #[must_use]
    pub fn weight(&self) -> Option<Weight> {
        match self {
            Self::Differs(changes) => changes.iter().map(|change| change.weight).max(),
            _ => None,
        }
    }

    /// In a word: `same`, `cosmetic`, `content`, `number`, `missing`, `extra`, `unreadable`, `broken`.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::Same => "same",
            Self::Differs(_) => self.weight().unwrap_or(Weight::Cosmetic).name(),
            Self::Missing(_) => "missing",
            Self::Extra => "extra",
            Self::Unreadable(_) => "unreadable",
            Self::Broken(_) => "broken",
        }
    }

    /// What there is to say, a line each.
    #[must_use]
    pub fn lines(&self) -> Vec<String> {
        match self {
            Self::Same => Vec::new(),
            Self::Differs(changes) => changes.iter().map(ToString::to_string).collect(),
            Self::Missing(what) | Self::Unreadable(what) | Self::Broken(what) => vec![what.clone()],
            Self::Extra => {
                vec!["no scene draws this golden; take its files away, or list its scene".to_owned()]
            }
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} ({}): {}", self.weight.name(), self.tier.name(), self.what)
    }
}

impl Report {
    /// Whether every golden is as it was blessed, and none is missing or left over.
    #[must_use]
    pub fn holds(&self) -> bool {
        self.checked.iter().all(|one| one.verdict == Verdict::Same)
    }

    /// How many goldens came out how.
    #[must_use]
    pub fn count(&self) -> Count {
        let mut count = Count::default();
        for one in &self.checked {
            *match &one.verdict {
                Verdict::Same => &mut count.same,
                Verdict::Differs(_) => match one.verdict.weight() {
                    Some(Weight::Number) => &mut count.number,
                    Some(Weight::Content) => &mut count.content,
                    Some(Weight::Cosmetic) | None => &mut count.cosmetic,
                },
                Verdict::Missing(_) => &mut count.missing,
                Verdict::Extra => &mut count.extra,
                Verdict::Unreadable(_) => &mut count.unreadable,
                Verdict::Broken(_) => &mut count.broken,
            } += 1;
        }
        count
    }

    /// One line for whoever reads the log of a test run.
    #[must_use]
    pub fn summary(&self) -> String {
        let count = self.count();
        let all = self.checked.len();
        let tiers: Vec<&str> = Tier::built().iter().map(|tier| tier.name()).collect();
        let unseen = if tiers.len() < 3 { "; pixels not compared: built without png" } else { "" };
        if self.holds() {
            return format!("golden: all {all} as blessed ({}){unseen}", tiers.join(", "));
        }
        let parts = [
            (count.number, "with a changed number"),
            (count.content, "with other content"),
            (count.cosmetic, "cosmetic"),
            (count.missing, "missing"),
            (count.extra, "extra"),
            (count.unreadable, "unreadable"),
            (count.broken, "broken"),
        ];
        let parts: Vec<String> =
            parts.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!("{n} {what}")).collect();
        format!("golden: {} of {all} as blessed; {}{unseen}", count.same, parts.join(", "))
    }
}

/// For tests: the suite in `folder` must be as it was blessed. Where the environment has `LINKGRAM_BLESS=1`,
/// blesses it instead.
///
/// # Panics
/// When a golden differs, with what differs and where the report is that shows it (written to `report`); when the
/// suite cannot be read or blessed.
#[expect(clippy::panic, reason = "an assertion")]
pub fn assert(folder: impl AsRef<Path>, report: impl AsRef<Path>) {
    let outcome = Suite::open(folder.as_ref()).and_then(|suite| {
        let suite = match report.as_ref().parent() {
            Some(folder) => suite.remembering(&folder.join("seen")),
            None => suite,
        };
        if std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1") {
            for blessed in suite.bless(&|| {})? {
                println!("{blessed}");
            }
            println!("now look at the pictures, and commit them on their own");
            return Ok(None);
        }
        let checked = suite.check(&|| {});
        if checked.holds() {
            return Ok(None);
        }
        let path = report.as_ref();
        if let Some(folder) = path.parent() {
            std::fs::create_dir_all(folder)
                .map_err(|error| GoldenError::File(format!("{}: {error}", crate::files::shown(folder))))?;
        }
        crate::files::write_all(&[(path.to_owned(), html(&checked).into_bytes())])
            .map_err(|error| GoldenError::File(error.to_string()))?;
        Ok(Some(checked))
    });
    match outcome {
        Ok(None) => {}
        Ok(Some(checked)) => {
            let (report, summary) = (crate::files::shown(report.as_ref()), checked.summary());
            panic!(
                "{checked}{summary}\nlook at {report}\nif the new ones are right, bless them with LINKGRAM_BLESS=1"
            );
        }
        Err(error) => panic!("{}: {error}", crate::files::shown(folder.as_ref())),
    }
}

/// So many changes of one golden are told in a text.
const TOLD: usize = 12;

impl Report {
    /// What is not as blessed, by its cause: what has one cause together, in it the largest change first.
    #[must_use]
    pub fn by_cause(&self) -> Vec<(Option<String>, Vec<&Checked>)> {
        let mut groups: Vec<(Option<String>, Vec<&Checked>)> = Vec::new();
        for one in self.checked.iter().filter(|one| one.verdict != Verdict::Same) {
            let cause = one.because();
            match groups.iter_mut().find(|(known, _)| *known == cause) {
                Some((_, all)) => all.push(one),
                None => groups.push((cause, vec![one])),
            }
        }
        for (_, all) in &mut groups {
            all.sort_by_key(|one| std::cmp::Reverse(one.size()));
        }
        groups.sort_by_key(|(_, all)| std::cmp::Reverse(all.first().map(|one| one.size())));
        groups
    }
}

impl fmt::Display for Report {
    /// What is not as blessed, golden by golden; what has one cause together.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (cause, all) in self.by_cause() {
            if let Some(cause) = cause {
                let goldens = if all.len() == 1 { "golden" } else { "goldens" };
                writeln!(f, "{cause} ({} {goldens})", all.len())?;
            }
            for one in all {
                writeln!(f, "{}: {}", one.name, one.verdict.word())?;
                let lines = one.verdict.lines();
                for line in lines.iter().take(TOLD) {
                    writeln!(f, "    {line}")?;
                }
                if lines.len() > TOLD {
                    writeln!(f, "    and {} more", lines.len() - TOLD)?;
                }
            }
        }
        Ok(())
    }
}
