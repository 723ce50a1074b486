//! A folder of goldens: drawn, compared, blessed.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use super::lines::{self, LINES, Lines};
use super::meaning::without_numbers;
use super::{Change, Checked, GoldenError, Keep, Meaning, Report, Tier, Verdict, Weight, manifest, scene};
use crate::drawing::{self, NoFigure, Wish};
use crate::render::theme::Theme;
use crate::render::{json, svg};
use crate::report::diagnose;
use crate::solve::SolveError;
use crate::{files, limits, parallel};

/// The ending of the file that has the meaning of a figure.
pub(super) const MEANING: &str = ".figure.json";
/// The ending of the drawing.
const SVG: &str = ".svg";
/// The ending of the picture.
const PIXELS: &str = ".png";
/// The ending of the file that has a refusal.
const REFUSAL: &str = ".refusal.txt";

/// The ending of the file that has the scene as it was.
pub(super) const SCENE: &str = ".scene.json";

/// A scene and how it is drawn.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Case {
    /// The name of the golden: its path in the suite, without endings.
    pub name: String,
    /// The file of the scene.
    pub scene: PathBuf,
    /// What is drawn of it.
    pub wish: Wish,
    /// On which paper; the scene's where nothing is said.
    pub paper: Option<String>,
    /// In which colours; the scene's where nothing is said.
    pub theme: Option<Theme>,
    /// How its golden is kept.
    pub keep: Keep,
}

/// What a scene comes to.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// A figure.
    Figure {
        /// Its JSON.
        json: String,
        /// Its SVG.
        svg: String,
    },
    /// The refusal that the scene expects, as text.
    Refusal(String),
}

/// Why a scene comes to nothing: one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum NotDrawn {
    /// It cannot be drawn.
    #[error("{0}")]
    Broken(String),
    /// The independent solver does not confirm what it shows.
    #[error("{0}")]
    Unconfirmed(String),
}

/// A folder of goldens.
#[derive(Debug, Clone, PartialEq)]
pub struct Suite {
    folder: PathBuf,
    cases: Vec<Case>,
    /// The goldens of one line.
    lines: Lines,
    /// Where drawings are kept that are as they were blessed.
    seen: Option<PathBuf>,
    /// The names of all cases, whether chosen or not.
    known: BTreeSet<String>,
    /// Whether only some cases were chosen.
    chosen: bool,
    /// Of the pictures.
    #[cfg_attr(not(feature = "png"), allow(dead_code, reason = "there are no pictures"))]
    dpi: f32,
}

/// The path of a file in a suite, with slashes on every system.
pub(super) fn name_in(folder: &Path, path: &Path) -> String {
    let inside = path.strip_prefix(folder).unwrap_or(path);
    inside.components().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/")
}

impl Suite {
    /// The suite of a folder.
    ///
    /// # Errors
    /// When the folder or its `suite.json` cannot be read, says what cannot be, or lists no scene.
    pub fn open(folder: &Path) -> Result<Self, GoldenError> {
        if !folder.is_dir() {
            return Err(GoldenError::File(format!("{}: not a folder", files::shown(folder))));
        }
        let (cases, dpi) = manifest::read(folder)?;
        if cases.is_empty() {
            return Err(GoldenError::Suite(format!("{}: no scene in this suite", files::shown(folder))));
        }
        let known = cases.iter().map(|case| case.name.clone()).collect();
        let lines = Lines::read(folder)?;
        Ok(Self { folder: folder.to_owned(), cases, lines, seen: None, known, chosen: false, dpi })
    }

    /// Keeps the drawings behind goldens of one line in a folder, as long as they are as they were blessed, so that it can
    /// be shown how they looked when they no longer are.
    #[must_use]
    pub fn remembering(mut self, folder: &Path) -> Self {
        self.seen = Some(folder.to_owned());
        self
    }

    /// The scenes and how they are drawn.
    #[must_use]
    pub fn cases(&self) -> &[Case] {
        &self.cases
    }

    /// Only the goldens of these names.
    ///
    /// # Errors
    /// When the suite has no golden of such a name.
    pub fn only(mut self, names: &[String]) -> Result<Self, GoldenError> {
        let known: Vec<&str> = self.known.iter().map(String::as_str).collect();
        if let Some(stranger) = names.iter().find(|name| !self.known.contains(*name)) {
            let mend = crate::scene::nearest(stranger, &known)
                .map_or(String::new(), |nearest| format!("; did you mean {nearest}?"));
            return Err(GoldenError::Suite(format!("no golden of the name {stranger} in this suite{mend}")));
        }
        self.cases.retain(|case| names.contains(&case.name));
        self.chosen = true;
        Ok(self)
    }

    fn path(&self, name: &str, ending: &str) -> PathBuf {
        self.folder.join(format!("{name}{ending}"))
    }

    /// Draws everything and compares it with what was blessed; `tick` is called after each figure.
    #[must_use]
    pub fn check(&self, tick: &(dyn Fn() + Sync)) -> Report {
        let mut checked = parallel::map(&self.cases, |case| {
            let checked = self.check_one(case);
            tick();
            checked
        });
        checked.extend(self.extra().into_iter().map(|name| Checked {
            name,
            verdict: Verdict::Extra,
            expected: None,
            actual: None,
            scene: None,
        }));
        Report { checked }
    }

    fn check_one(&self, case: &Case) -> Checked {
        let name = case.name.clone();
        let looked = match case.draw() {
            Ok(outcome) => self.look(case, &outcome),
            Err(why) => {
                let expected = self.text(&name, SVG).ok().flatten();
                let verdict = match why {
                    NotDrawn::Broken(why) => Verdict::Broken(why),
                    NotDrawn::Unconfirmed(why) => Verdict::Differs(vec![Change::new(Weight::Content, why)]),
                };
                Looked { verdict, expected, actual: None }
            }
        };
        let Looked { verdict, expected, actual } = looked;
        let scene = if verdict == Verdict::Same { None } else { self.scene_changes(case) };
        Checked { name, verdict, expected, actual, scene }
    }

    /// What changed in a scene since its golden was blessed.
    fn scene_changes(&self, case: &Case) -> Option<Vec<String>> {
        let old = self.text(&case.name, SCENE).ok().flatten()?;
        let (_, new) = files::read(&case.scene).ok()?;
        scene::changes(&old, &new)
    }

    fn look(&self, case: &Case, outcome: &Outcome) -> Looked {
        match case.keep {
            Keep::Files => self.compare(&case.name, outcome),
            Keep::Line => self.compare_line(&case.name, outcome),
        }
    }

    fn compare_line(&self, name: &str, outcome: &Outcome) -> Looked {
        let actual = Some(outcome.shown().to_owned());
        let new = match lines::sums(outcome) {
            Ok(new) => new,
            Err(why) => {
                return Looked { verdict: Verdict::Broken(format!("{name}: {why}")), expected: None, actual };
            }
        };
        let Some(old) = self.lines.get(name) else {
            let verdict =
                Verdict::Missing(format!("no line of {name} in {LINES}; look at the figure and bless it"));
            return Looked { verdict, expected: None, actual };
        };
        let seen = self.seen.as_ref().map(|folder| folder.join(format!("{name}{SVG}")));
        let before = seen.as_ref().and_then(|path| fs::read_to_string(path).ok());
        let before = before.filter(|svg| lines::is_of(old, svg));
        let changes = lines::changes(old, &new);
        if changes.is_empty() {
            // Only to be shown one day: where it cannot be kept, it is not shown.
            if let (Some(path), Outcome::Figure { svg, .. }, None) = (&seen, outcome, &before) {
                let folder = path.parent().map_or(Ok(()), fs::create_dir_all);
                let _ = folder.and_then(|()| fs::write(path, svg));
            }
            return Looked::same();
        }
        Looked { verdict: Verdict::Differs(changes), expected: before, actual }
    }

    /// What an outcome is against its golden.
    fn compare(&self, name: &str, outcome: &Outcome) -> Looked {
        let result = match outcome {
            Outcome::Refusal(refusal) => self.compare_refusal(name, refusal),
            Outcome::Figure { json, svg } => self.compare_figure(name, json, svg),
        };
        result.unwrap_or_else(|verdict| Looked {
            verdict,
            expected: None,
            actual: Some(outcome.shown().to_owned()),
        })
    }

    fn compare_refusal(&self, name: &str, refusal: &str) -> Result<Looked, Verdict> {
        let Some(golden) = self.text(name, REFUSAL)? else {
            if self.path(name, MEANING).exists() {
                let change =
                    Change::new(Weight::Content, format!("refused now, as the scene expects: {refusal}"));
                let expected = self.text(name, SVG)?;
                let actual = Some(refusal.to_owned());
                return Ok(Looked { verdict: Verdict::Differs(vec![change]), expected, actual });
            }
            return Err(self.missing(name, REFUSAL));
        };
        if with_plain_ends(&golden) == refusal {
            return Ok(Looked::same());
        }
        let change = match without_numbers(&golden) == without_numbers(refusal) {
            true => Change::new(Weight::Number, "a number in the refusal changed"),
            false => Change::new(Weight::Content, "the refusal is worded otherwise"),
        };
        Ok(Looked {
            verdict: Verdict::Differs(vec![change]),
            expected: Some(golden),
            actual: Some(refusal.to_owned()),
        })
    }

    fn compare_figure(&self, name: &str, json: &str, svg: &str) -> Result<Looked, Verdict> {
        let Some(golden) = self.text(name, MEANING)? else {
            if let Some(refusal) = self.text(name, REFUSAL)? {
                let change = Change::new(Weight::Content, "drawn now, where it was refused");
                let (expected, actual) = (Some(refusal), Some(svg.to_owned()));
                return Ok(Looked { verdict: Verdict::Differs(vec![change]), expected, actual });
            }
            return Err(self.missing(name, MEANING));
        };
        let unreadable = |ending: &str, why: String| {
            Verdict::Unreadable(format!("{}: {why}; bless it anew", files::shown(&self.path(name, ending))))
        };
        let mut changes = Vec::new();
        if with_plain_ends(&golden) != json {
            let expected = Meaning::read(&golden).map_err(|why| unreadable(MEANING, why))?;
            let actual = Meaning::read(json).map_err(|why| unreadable(MEANING, why))?;
            changes = expected.changes(&actual);
        }
        let said = changes.len();
        let expected = self.text(name, SVG)?;
        let mut missing = None;
        for (tier, seen) in [
            (Tier::Svg, compare_bytes(expected.as_deref(), svg)),
            (Tier::Pixels, self.compare_pixels(name, svg)?),
        ] {
            let what = match seen {
                Seen::Same => continue,
                Seen::Differs(what) => what,
                Seen::Missing(ending) => {
                    missing = missing.or(Some(ending));
                    "no golden".to_owned()
                }
            };
            changes.push(Change::looks(tier, what));
        }
        if changes.is_empty() {
            return Ok(Looked::same());
        }
        // Where nothing else is to be said: that a file is not there.
        let verdict = match missing {
            Some(ending) if said == 0 => self.missing(name, ending),
            _ => Verdict::Differs(changes),
        };
        Ok(Looked { verdict, expected, actual: Some(svg.to_owned()) })
    }

    #[cfg(feature = "png")]
    fn compare_pixels(&self, name: &str, svg: &str) -> Result<Seen, Verdict> {
        use super::pixels::Picture;
        let path = self.path(name, PIXELS);
        let Some(bytes) = bytes(&path)? else { return Ok(Seen::Missing(PIXELS)) };
        let unreadable =
            |why: String| Verdict::Unreadable(format!("{}: {why}; bless it anew", files::shown(&path)));
        let expected = Picture::read(&bytes).map_err(unreadable)?;
        let actual = Picture::of_svg(svg, self.dpi);
        let actual = actual.map_err(|error| Verdict::Broken(format!("{name}: {error}")))?;
        let difference = expected.difference(&actual);
        Ok(if difference.seen() { Seen::Differs(difference.to_string()) } else { Seen::Same })
    }

    #[cfg(not(feature = "png"))]
    #[expect(clippy::unused_self, clippy::unnecessary_wraps, reason = "as it is with pictures")]
    fn compare_pixels(&self, _: &str, _: &str) -> Result<Seen, Verdict> {
        Ok(Seen::Same)
    }

    /// The files that there are of a golden. What bears such a name where nothing was blessed is somebody's own.
    fn files_of(&self, name: &str) -> Vec<PathBuf> {
        let there = |ending: &&str| self.path(name, ending).is_file();
        if ![MEANING, REFUSAL].iter().any(there) {
            return Vec::new();
        }
        let endings = [MEANING, SVG, PIXELS, REFUSAL, SCENE];
        endings.iter().filter(|ending| there(ending)).map(|ending| self.path(name, ending)).collect()
    }

    /// A file that is no golden and stands where one is to be written for the first time: somebody's own figure or scene.
    fn in_the_way(&self, case: &Case, outcome: &Outcome) -> Option<PathBuf> {
        let Outcome::Figure { svg, .. } = outcome else { return None };
        if !self.files_of(&case.name).is_empty() {
            return None;
        }
        let there = |ending: &str| self.path(&case.name, ending).symlink_metadata().is_ok();
        let is_same = |ending: &str, new: &[u8]| {
            bytes(&self.path(&case.name, ending)).is_ok_and(|old| old.as_deref() == Some(new))
        };
        // A copy of the scene was left by a bless, whose other files may have been lost.
        let scene = files::read(&case.scene).ok()?.1;
        if is_same(SCENE, scene.as_bytes()) {
            return None;
        }
        let foreign = [SCENE, PIXELS, SVG].into_iter().filter(|ending| there(ending));
        // What is there already as it would be written is in nobody's way.
        let mut foreign = foreign.filter(|ending| *ending != SVG || !is_same(SVG, svg.as_bytes()));
        foreign.next().map(|ending| self.path(&case.name, ending))
    }

    fn missing(&self, name: &str, ending: &str) -> Verdict {
        Verdict::Missing(format!(
            "{}: not there; look at the figure and bless it",
            files::shown(&self.path(name, ending))
        ))
    }

    /// The text of a golden file; `None` where there is no such file.
    fn text(&self, name: &str, ending: &str) -> Result<Option<String>, Verdict> {
        let path = self.path(name, ending);
        let Some(bytes) = bytes(&path)? else { return Ok(None) };
        let text = String::from_utf8(bytes);
        text.map(Some).map_err(|_| {
            Verdict::Unreadable(format!("{}: not UTF-8 text; bless it anew", files::shown(&path)))
        })
    }

    /// The goldens to which no scene belongs, by their names.
    fn extra(&self) -> Vec<String> {
        if self.chosen {
            return Vec::new();
        }
        let Ok(all) = files::all_under(&self.folder) else { return Vec::new() };
        let golden = |path: &PathBuf| {
            let name = name_in(&self.folder, path);
            [MEANING, REFUSAL].iter().find_map(|ending| name.strip_suffix(ending)).map(str::to_owned)
        };
        let names: BTreeSet<String> = all.iter().filter_map(golden).collect();
        let lines = self.lines.names().cloned();
        let names: BTreeSet<String> = names.into_iter().chain(lines).collect();
        names.difference(&self.known).cloned().collect()
    }

    /// Makes what is drawn now the golden: a line for each that is new or changed, with the tiers in which it
    /// differed. Each golden is written whole or not at all. Files that no figure of the suite writes are left alone;
    /// where a scene is refused that was drawn before, or the other way round, its own former files go.
    ///
    /// # Errors
    /// When a scene cannot be drawn, or is not refused although it expects to be: nothing is written then. When
    /// a file cannot be written: the goldens before it are blessed, it and those after it are not.
    pub fn bless(&self, tick: &(dyn Fn() + Sync)) -> Result<Vec<String>, GoldenError> {
        let drawn = parallel::map(&self.cases, |case| {
            let drawn = case.draw().map(|outcome| {
                let looked = self.look(case, &outcome);
                (outcome, looked.verdict)
            });
            tick();
            drawn
        });
        let (mut broken, mut unconfirmed) = (Vec::new(), Vec::new());
        for why in drawn.iter().filter_map(|drawn| drawn.as_ref().err()) {
            match why {
                NotDrawn::Broken(why) => broken.push(why.clone()),
                NotDrawn::Unconfirmed(why) => unconfirmed.push(why.clone()),
            }
        }
        if !broken.is_empty() {
            return Err(GoldenError::Broken(broken));
        }
        if !unconfirmed.is_empty() {
            return Err(GoldenError::Unconfirmed(unconfirmed));
        }
        // Nothing is written where a link leads out of the suite.
        for case in &self.cases {
            let inside = files::inside(&self.folder, &self.path(&case.name, SVG));
            inside.map_err(|error| GoldenError::File(error.to_string()))?;
        }
        // Two who bless one suite do so one after another.
        let _held = files::hold(&self.folder);
        for (case, (outcome, _)) in self.cases.iter().zip(drawn.iter().flatten()) {
            if let Some(path) = self.in_the_way(case, outcome).filter(|_| case.keep == Keep::Files) {
                return Err(GoldenError::File(format!(
                    "{}: it stands where the golden of {} is to be, and is none; move it away, or keep the scenes of the suite in a folder of their own",
                    files::shown(&path),
                    case.name
                )));
            }
        }
        let mut told = Vec::new();
        let mut recorded = self.lines.clone();
        let in_files: BTreeSet<&str> = {
            let cases = self.cases.iter().filter(|case| case.keep == Keep::Files);
            cases.map(|case| case.name.as_str()).collect()
        };
        recorded.retain(|name| !in_files.contains(name) && (self.chosen || self.known.contains(name)));
        for (case, (outcome, verdict)) in self.cases.iter().zip(drawn.into_iter().flatten()) {
            let written = match case.keep {
                Keep::Files => self.write(case, &outcome, &verdict)?,
                Keep::Line => {
                    let sums = lines::sums(&outcome)
                        .map_err(|why| GoldenError::Broken(vec![format!("{}: {why}", case.name)]))?;
                    recorded.put(&case.name, sums) || !self.files_of(&case.name).is_empty()
                }
            };
            if written {
                told.push(blessed(&case.name, &verdict));
            }
        }
        if recorded != self.lines {
            files::write_all(&[(self.folder.join(LINES), recorded.text().into_bytes())])
                .map_err(|error| GoldenError::File(error.to_string()))?;
        }
        // The files of what is kept as a line from now on.
        let in_lines = self.cases.iter().filter(|case| case.keep == Keep::Line);
        for path in in_lines.flat_map(|case| self.files_of(&case.name)) {
            fs::remove_file(&path)
                .map_err(|error| GoldenError::File(format!("{}: {error}", path.display())))?;
        }
        let extra = self.extra().into_iter().map(|name| match self.lines.get(&name) {
            Some(_) => format!("{name}: its line is taken away, for no scene draws it"),
            None => format!("{name}: left alone, though no scene draws it"),
        });
        told.extend(extra);
        Ok(told)
    }

    /// Whether anything was written.
    fn write(&self, case: &Case, outcome: &Outcome, verdict: &Verdict) -> Result<bool, GoldenError> {
        let name = case.name.as_str();
        let file = |error: &dyn std::fmt::Display| GoldenError::File(error.to_string());
        let (mut wanted, former) = match outcome {
            Outcome::Refusal(text) => {
                let drawn = self.path(name, MEANING).exists();
                let former: &[&str] = if drawn { &[MEANING, SVG, PIXELS, SCENE] } else { &[] };
                (vec![(self.path(name, REFUSAL), text.clone().into_bytes())], former)
            }
            Outcome::Figure { json, svg } => {
                let mut own = vec![
                    (self.path(name, MEANING), json.clone().into_bytes()),
                    (self.path(name, SVG), svg.clone().into_bytes()),
                ];
                own.extend(self.picture(name, svg, verdict)?);
                // The scene as it is now, so that it can be told one day what in it changed.
                if let Ok((_, scene)) = files::read(&case.scene) {
                    own.push((self.path(name, SCENE), scene.into_bytes()));
                }
                (own, &[REFUSAL][..])
            }
        };
        wanted.retain(|(path, new)| !bytes(path).is_ok_and(|old| old.as_ref() == Some(new)));
        if let Some(folder) = wanted.first().and_then(|(path, _)| path.parent()) {
            fs::create_dir_all(folder)
                .map_err(|error| file(&format!("{}: {error}", files::shown(folder))))?;
        }
        files::write_all(&wanted).map_err(|error| file(&error))?;
        let mut changed = !wanted.is_empty();
        for ending in former {
            let path = self.path(name, ending);
            if path.symlink_metadata().is_ok() {
                fs::remove_file(&path).map_err(|error| file(&format!("{}: {error}", files::shown(&path))))?;
                changed = true;
            }
        }
        Ok(changed)
    }

    /// The picture, where the present one no longer serves.
    #[cfg(feature = "png")]
    fn picture(
        &self,
        name: &str,
        svg: &str,
        verdict: &Verdict,
    ) -> Result<Option<(PathBuf, Vec<u8>)>, GoldenError> {
        let seen = match verdict {
            Verdict::Same => false,
            Verdict::Differs(changes) => changes.iter().any(|change| change.tier == Tier::Pixels),
            _ => true,
        };
        let path = self.path(name, PIXELS);
        if !seen && path.exists() {
            return Ok(None);
        }
        let picture = super::pixels::Picture::of_svg(svg, self.dpi);
        let picture = picture.map_err(|error| GoldenError::Broken(vec![format!("{name}: {error}")]))?;
        Ok(Some((path, picture.png())))
    }

    #[cfg(not(feature = "png"))]
    #[expect(clippy::unused_self, clippy::unnecessary_wraps, reason = "as it is with pictures")]
    fn picture(&self, _: &str, _: &str, _: &Verdict) -> Result<Option<(PathBuf, Vec<u8>)>, GoldenError> {
        Ok(None)
    }
}

/// A golden that was compared.
struct Looked {
    verdict: Verdict,
    expected: Option<String>,
    actual: Option<String>,
}

impl Looked {
    const fn same() -> Self {
        Self { verdict: Verdict::Same, expected: None, actual: None }
    }
}

/// A golden file of a later tier, compared.
enum Seen {
    Same,
    Differs(String),
    /// There is no such file; its ending.
    Missing(&'static str),
}

fn compare_bytes(expected: Option<&str>, svg: &str) -> Seen {
    let Some(expected) = expected else { return Seen::Missing(SVG) };
    if expected == svg {
        return Seen::Same;
    }
    if with_plain_ends(expected) == svg {
        let what = "its lines end in CR LF; say `*.svg text eol=lf` in .gitattributes";
        return Seen::Differs(what.to_owned());
    }
    let same = expected.lines().zip(svg.lines()).take_while(|(a, b)| a == b).count();
    Seen::Differs(format!("differs from line {} on", same + 1))
}

/// What a bless did, in one line.
fn blessed(name: &str, verdict: &Verdict) -> String {
    match verdict {
        Verdict::Differs(changes) => {
            let tiers: BTreeSet<Tier> = changes.iter().map(|change| change.tier).collect();
            let tiers: Vec<&str> = tiers.iter().map(|tier| tier.name()).collect();
            let first = changes.first().map_or("", |change| change.what.as_str());
            let more = changes.len().saturating_sub(1);
            let more = if more == 0 { String::new() } else { format!(", and {more} more") };
            format!("{name}: {}, in {}: {first}{more}", verdict.word(), tiers.join(", "))
        }
        Verdict::Missing(_) => format!("{name}: new"),
        Verdict::Unreadable(why) => format!("{name}: replaced; it was unreadable: {why}"),
        Verdict::Same | Verdict::Extra | Verdict::Broken(_) => format!("{name}: written anew"),
    }
}

/// The bytes of a file; `None` where there is none.
fn bytes(path: &Path) -> Result<Option<Vec<u8>>, Verdict> {
    // A link that leads nowhere is told when it is read.
    if path.symlink_metadata().is_err_and(|error| error.kind() == std::io::ErrorKind::NotFound) {
        return Ok(None);
    }
    let read = files::read_bytes(path, limits::GOLDEN);
    read.map(Some).map_err(|error| Verdict::Unreadable(error.to_string()))
}

fn with_plain_ends(text: &str) -> String {
    text.replace("\r\n", "\n")
}

impl Outcome {
    /// What there is to be seen of it.
    fn shown(&self) -> &str {
        match self {
            Self::Figure { svg, .. } => svg,
            Self::Refusal(text) => text,
        }
    }
}

impl Case {
    /// Draws the scene, or has it refused as it expects.
    ///
    /// # Errors
    /// One line, naming the file: where it is no scene, is refused without expecting it, or is not refused although
    /// it expects to be; where the independent solver does not confirm what it shows.
    pub fn draw(&self) -> Result<Outcome, NotDrawn> {
        let (file, text) = files::read(&self.scene).map_err(|error| NotDrawn::Broken(error.to_string()))?;
        let scene = crate::scene::read(&text, &file);
        let mut scene = scene.map_err(|error| NotDrawn::Broken(error.to_string()))?;
        if let Some(paper) = &self.paper {
            scene.sheet.paper = Some(paper.clone());
        }
        match (drawing::figure(&scene, &self.wish), scene.expect) {
            (Ok(figure), None) => {
                let theme = self.theme.unwrap_or_else(|| drawing::theme(&scene));
                Ok(Outcome::Figure { json: json::write(&figure), svg: svg::write_in(&figure, theme) })
            }
            (Ok(_), Some(_)) => {
                Err(NotDrawn::Broken(format!("{file}: the scene expects a refusal, and is drawn")))
            }
            (Err(NoFigure::Unsolved(error)), Some(expected)) if error.refusal() == Some(expected) => {
                Ok(Outcome::Refusal(refusal(&scene, &error)))
            }
            (Err(NoFigure::Unconfirmed(why)), _) => {
                Err(NotDrawn::Unconfirmed(format!("{file}: not confirmed: {why}")))
            }
            (Err(error), _) => Err(NotDrawn::Broken(error.told(&scene))),
        }
    }
}

/// A refusal as text: where in the scene, what, and the mend; without line and column, which move with every edit.
fn refusal(scene: &crate::scene::Scene, error: &SolveError) -> String {
    let told = diagnose(scene, error);
    let mut lines = vec![told.path, told.what];
    lines.extend(told.mend.map(|mend| format!("help: {mend}")));
    lines.retain(|line| !line.is_empty());
    lines.join("\n") + "\n"
}
