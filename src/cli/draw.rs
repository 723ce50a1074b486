//! `linkgram draw`.

use std::path::{Path, PathBuf};

use super::{Ending, Failure, print_bytes, read_scene};
use crate::drawing::{self, Kind, NoFigure, Wish, unknown, unknown_figure};
use crate::files;
use crate::render::theme::Theme;
use crate::render::{self, Format, Lettering};
use crate::scene::Scene;
use crate::sheet::{Figure, Language};
use crate::solve::Settings;

/// What is to be drawn, and where.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) output: Vec<PathBuf>,
    pub(super) figure: Vec<String>,
    pub(super) kind: Kind,
    pub(super) play: bool,
    pub(super) paper: Option<String>,
    pub(super) lang: Option<String>,
    pub(super) dpi: Option<f32>,
    pub(super) settings: Settings,
    pub(super) theme: Option<String>,
    pub(super) text: Option<String>,
    pub(super) format: Option<String>,
    pub(super) positions: Vec<String>,
    pub(super) other_assembly: bool,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let formats = formats(job)?;
    let lettering = lettering(job, &formats)?;
    if let Some(unknown) = job.figure.iter().find_map(|name| unknown_figure(name)) {
        return Err(Failure(unknown));
    }
    let dpi = resolution(job, &formats)?;
    files::spare(&job.scene, &job.output)?;
    let (_, mut scene) = read_scene(&job.scene)?;
    if let Some(paper) = &job.paper {
        let size = crate::scene::paper_size(paper);
        scene.sheet.paper = Some(size.ok_or_else(|| {
            Failure(format!("--paper {paper}: choose A0 to A6, letter or legal, such as \"A3 landscape\""))
        })?);
    }
    if job.positions.len() > crate::limits::POSITIONS {
        let most = crate::limits::POSITIONS;
        return Err(Failure(format!("--positions: {most} at most can be told apart")));
    }
    if !job.positions.is_empty() {
        let places = job.positions.iter().map(|text| crate::scene::input_place(text, &scene));
        let places = places.collect::<Result<Vec<f64>, String>>();
        scene.sheet.positions = places.map_err(|why| Failure(format!("--positions: {why}")))?;
    }
    scene.sheet.other_assembly |= job.other_assembly;
    let scene = &scene;
    let wish = Wish {
        kind: job.kind,
        figures: job.figure.clone(),
        language: language(job)?,
        settings: job.settings,
    };
    let options = render::Options { theme: theme(job, scene)?, lettering, dpi };
    let impossible = |error: NoFigure| match error {
        NoFigure::Unconfirmed(_) => Failure::unconfirmed(error.told(scene)),
        _ => Failure(error.told(scene)),
    };
    if job.play {
        let frames = drawing::film(scene, &wish).map_err(impossible)?;
        return write_film(job, &formats, &frames, &options);
    }
    let figure = drawing::figure(scene, &wish).map_err(impossible)?;
    let bytes = |format: &Format| {
        render::render(&figure, *format, &options).map_err(|error| Failure(error.to_string()))
    };
    if job.output.is_empty() {
        for format in &formats {
            print_bytes(&bytes(format)?)?;
        }
        return Ok(Ending::Fine);
    }
    let mut written = Vec::new();
    for (path, format) in job.output.iter().zip(&formats) {
        written.push((path.clone(), bytes(format)?));
    }
    files::write_all(&written)?;
    Ok(Ending::Fine)
}

/// The format of each output; of standard output where there is none.
fn formats(job: &Job) -> Result<Vec<Format>, Failure> {
    let chosen = |name: &String| {
        let known = Format::ALL.map(Format::name);
        Format::from_name(name).ok_or_else(|| Failure(unknown("format", name, name, &known)))
    };
    if job.output.is_empty() {
        return Ok(vec![job.format.as_ref().map(chosen).transpose()?.unwrap_or_default()]);
    }
    if job.format.is_some() {
        let what = "--format is for standard output; the ending of a file's name chooses its format";
        return Err(Failure(what.to_owned()));
    }
    job.output.iter().map(|path| format_of(path)).collect()
}

fn format_of(path: &Path) -> Result<Format, Failure> {
    let ending = path.extension().and_then(|e| e.to_str()).and_then(Format::from_name);
    ending.ok_or_else(|| {
        let known = Format::ALL.map(|format| format!(".{}", format.name()));
        let path = files::shown(path);
        Failure(format!("{path}: unknown format; end the name in {}", one_of(&known)))
    })
}

/// `a, b or c`.
fn one_of(names: &[String]) -> String {
    match names {
        [all @ .., last] if !all.is_empty() => format!("{} or {last}", all.join(", ")),
        _ => names.concat(),
    }
}

fn lettering(job: &Job, formats: &[Format]) -> Result<Lettering, Failure> {
    let Some(name) = &job.text else { return Ok(Lettering::default()) };
    let known = Lettering::ALL.map(Lettering::name);
    let kind =
        Lettering::from_name(name).ok_or_else(|| Failure(unknown("kind of text", name, name, &known)))?;
    if !formats.contains(&Format::Svg) {
        return Err(Failure(format!("--text {name} is for SVG, and none is written: end a name in .svg")));
    }
    Ok(kind)
}

/// Dots per inch: what is asked, or what is usual.
fn resolution(job: &Job, formats: &[Format]) -> Result<f32, Failure> {
    let Some(dpi) = job.dpi else { return Ok(render::Options::default().dpi) };
    if !(dpi.is_finite() && (10.0..=2400.0).contains(&dpi)) {
        return Err(Failure(format!("--dpi {dpi}: choose between 10 and 2400")));
    }
    if !formats.contains(&Format::Png) {
        return Err(Failure(format!("--dpi {dpi} is for PNG, and none is written: end a name in .png")));
    }
    Ok(dpi)
}

fn theme(job: &Job, scene: &Scene) -> Result<Theme, Failure> {
    let Some(name) = &job.theme else { return Ok(drawing::theme(scene)) };
    Theme::from_name(name).ok_or_else(|| Failure(unknown("theme", name, name, &Theme::ALL.map(Theme::name))))
}

fn language(job: &Job) -> Result<Option<Language>, Failure> {
    job.lang.as_deref().map(super::language).transpose()
}

/// Writes the steps as a film.
fn write_film(
    job: &Job,
    formats: &[Format],
    frames: &[Figure],
    options: &render::Options,
) -> Result<Ending, Failure> {
    if let Some((path, _)) = job.output.iter().zip(formats).find(|(_, format)| !matches!(format, Format::Svg))
    {
        return Err(Failure(format!("{}: only SVG plays; end the name in .svg", files::shown(path))));
    }
    if job.output.is_empty() && formats != [Format::Svg] {
        return Err(Failure("--play: only SVG plays".to_owned()));
    }
    let svg = render::film(frames, options).map_err(|error| Failure(error.to_string()))?;
    if job.output.is_empty() {
        print_bytes(svg.as_bytes())?;
        return Ok(Ending::Fine);
    }
    let written: Vec<_> = job.output.iter().map(|path| (path.clone(), svg.clone().into_bytes())).collect();
    files::write_all(&written)?;
    Ok(Ending::Fine)
}
