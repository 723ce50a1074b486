//! Which scenes a suite draws, how, and under which names.

use std::collections::BTreeMap;
use std::path::{Component, Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;

use super::suite::Case;
use super::{GoldenError, suite};
use crate::drawing::{Kind, Wish, unknown, unknown_figure};
use crate::render::theme::Theme;
use crate::sheet::Language;
use crate::{files, limits};

/// The name of the file in a suite's folder that lists its figures.
pub const MANIFEST: &str = "suite.json";
/// Resolution of golden pictures where nothing is said, pixels per inch: enough to see a moved stroke, small
/// enough for a repository.
pub(super) const DPI: f32 = 48.0;

/// What is wrong with a suite's own file.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}: {what}")]
pub struct ManifestError {
    /// The file, with line and column where they are known.
    pub file: String,
    /// What is wrong.
    pub what: String,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `figures`")]
struct Manifest {
    #[serde(default = "dpi")]
    dpi: f32,
    figures: Vec<Listed>,
}

const fn dpi() -> f32 {
    DPI
}

/// How a golden is kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Keep {
    /// As files: what it says, its SVG, its picture.
    #[default]
    Files,
    /// As checksums, a line in [`LINES`](super::LINES).
    Line,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, expecting = "an object with `scenes`")]
struct Listed {
    scenes: Vec<String>,
    #[serde(default)]
    except: Vec<String>,
    name: Option<String>,
    #[serde(rename = "as")]
    kind: Option<String>,
    #[serde(default)]
    figure: Vec<String>,
    lang: Option<String>,
    paper: Option<String>,
    theme: Option<String>,
    #[serde(default)]
    keep: Keep,
}

/// The figures of the suite in a folder, and the resolution of their pictures.
pub(super) fn read(folder: &Path) -> Result<(Vec<Case>, f32), GoldenError> {
    let path = folder.join(MANIFEST);
    if !path.is_file() {
        return Ok((beside(folder)?, DPI));
    }
    let (file, text) = files::read(&path).map_err(|error| GoldenError::File(error.to_string()))?;
    let wrong = |what: String| ManifestError { file: file.clone(), what };
    let manifest: Manifest =
        serde_json::from_str(text.strip_prefix('\u{feff}').unwrap_or(&text)).map_err(|error| {
            let (line, column, told) = (error.line(), error.column(), error.to_string());
            let what = told.strip_suffix(&format!(" at line {line} column {column}")).unwrap_or(&told);
            ManifestError { file: format!("{file}:{line}:{column}"), what: what.to_owned() }
        })?;
    if !(10.0..=600.0).contains(&manifest.dpi) {
        return Err(wrong(format!("`dpi` is {}: choose between 10 and 600", manifest.dpi)).into());
    }
    let mut cases = Vec::new();
    let mut places: BTreeMap<String, String> = BTreeMap::new();
    for (index, listed) in manifest.figures.iter().enumerate() {
        let here = format!("figures[{index}]");
        let wrong = |what: String| wrong(format!("{here}: {what}"));
        let wish = listed.wish().map_err(wrong)?;
        if listed.scenes.is_empty() {
            return Err(wrong("`scenes` lists no scene".to_owned()).into());
        }
        for scene in listed.found(folder)? {
            let name = listed.named(&scene).map_err(wrong)?;
            // What is kept as files needs no line.
            let kept = Case { name: name.clone(), scene: scene.clone(), keep: Keep::Files, ..wish.clone() };
            if wish.keep == Keep::Line && cases.contains(&kept) {
                continue;
            }
            if let Some(other) = places.insert(name.clone(), here.clone()) {
                let what =
                    format!("a second golden of the name {name} (the first is of {other}); give it a `name`");
                return Err(wrong(what).into());
            }
            if cases.len() == limits::FIGURES {
                let most = limits::grouped(limits::FIGURES);
                return Err(wrong(format!("more than {most} figures in one suite")).into());
            }
            cases.push(Case { name, scene, ..wish.clone() });
        }
    }
    Ok((cases, manifest.dpi))
}

/// Without a manifest: every scene of the folder, its golden beside it.
fn beside(folder: &Path) -> Result<Vec<Case>, GoldenError> {
    let scenes = files::all_under(folder).map_err(|error| GoldenError::File(error.to_string()))?;
    let scenes = scenes.into_iter().filter(|path| is_scene(path));
    let case = |scene: PathBuf| Case {
        name: suite::name_in(folder, &scene.with_extension("")),
        scene,
        ..Case::default()
    };
    Ok(scenes.map(case).collect())
}

/// A JSON file that is no figure.
fn is_scene(path: &Path) -> bool {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let golden = [suite::MEANING, suite::SCENE].iter().any(|ending| name.ends_with(ending));
    name.ends_with(".json") && !golden && name != MANIFEST
}

impl Listed {
    /// The listed options as a case without a scene.
    fn wish(&self) -> Result<Case, String> {
        let kind = match &self.kind {
            None => Kind::default(),
            Some(name) => Kind::from_name(name)
                .ok_or_else(|| unknown("`as`", name, name, &Kind::ALL.map(Kind::name)))?,
        };
        let language = match &self.lang {
            None => None,
            Some(tag) => {
                Some(Language::from_tag(tag).ok_or_else(|| unknown("`lang`", tag, tag, &Language::tags()))?)
            }
        };
        let theme = match &self.theme {
            None => None,
            Some(name) => Some(
                Theme::from_name(name)
                    .ok_or_else(|| unknown("`theme`", name, name, &Theme::ALL.map(Theme::name)))?,
            ),
        };
        let paper = match &self.paper {
            None => None,
            Some(size) => Some(crate::scene::paper_size(size).ok_or_else(|| {
                format!("`paper` {size}: choose A0 to A6, letter or legal, such as \"A3 landscape\"")
            })?),
        };
        if let Some(unknown) = self.figure.iter().find_map(|name| unknown_figure(name)) {
            return Err(unknown);
        }
        let wish = Wish { kind, figures: self.figure.clone(), language, ..Wish::default() };
        Ok(Case { wish, paper, theme, keep: self.keep, ..Case::default() })
    }

    fn found(&self, folder: &Path) -> Result<Vec<PathBuf>, GoldenError> {
        let except: Vec<PathBuf> = self.except.iter().map(|listed| folder.join(listed)).collect();
        let mut found = Vec::new();
        for listed in &self.scenes {
            let path = folder.join(listed);
            if !path.is_dir() {
                found.push(path);
                continue;
            }
            let all = files::all_under(&path).map_err(|error| GoldenError::File(error.to_string()))?;
            let before = found.len();
            found.extend(
                all.into_iter()
                    .filter(|path| is_scene(path) && !except.iter().any(|except| path.starts_with(except))),
            );
            if found.len() == before {
                return Err(GoldenError::Suite(format!("{}: no scene in this folder", files::shown(&path))));
            }
        }
        Ok(found)
    }

    /// The name of the golden of a scene.
    fn named(&self, scene: &Path) -> Result<String, String> {
        let stem = scene.file_stem().map(|stem| stem.to_string_lossy().into_owned()).unwrap_or_default();
        let name = self.name.as_deref().unwrap_or("*").replace('*', &stem);
        // Goldens are written: nothing outside of the suite is.
        let inside = |part: Component<'_>| matches!(part, Component::Normal(_));
        let parts = || Path::new(&name).components();
        if name.is_empty() || name.ends_with('/') || name.contains(char::is_control) || !parts().all(inside) {
            return Err(format!("`name` {name}: not a name in this folder"));
        }
        // `a//b` and `a/./b` are one file, and one name.
        Ok(parts().map(|part| part.as_os_str().to_string_lossy()).collect::<Vec<_>>().join("/"))
    }
}
