//! `linkgram draw`.

use std::path::{Path, PathBuf};

use super::report::short;
use super::{Ending, Failure, failure, files, print_bytes, read_scene};
use crate::plan::Extent;
use crate::render::theme::Theme;
use crate::render::{self, Format, Lettering};
use crate::scene::{Scene, Subject};
use crate::sheet::{self, Figure};

/// No sheet is wider or higher, all its pages together (mm): scales stated by mistake, and a picture that
/// no program opens.
const LARGEST_SHEET: f64 = 100_000.0;

/// What is to be drawn, and where.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) output: Vec<PathBuf>,
    pub(super) figure: Vec<String>,
    pub(super) lang: Option<String>,
    pub(super) dpi: f32,
    pub(super) theme: Option<String>,
    pub(super) text: Option<String>,
    pub(super) format: Option<String>,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let formats = formats(job)?;
    let lettering = lettering(job, &formats)?;
    if let Some(unknown) = job.figure.iter().find_map(|name| unknown_figure(name)) {
        return Err(Failure(unknown));
    }
    if !(job.dpi.is_finite() && (10.0..=2400.0).contains(&job.dpi)) {
        return Err(Failure(format!("--dpi {}: choose between 10 and 2400", job.dpi)));
    }
    let (_, scene) = read_scene(&job.scene)?;
    let scene = &scene;
    if let Some(unknown) = scene.sheet.figures.iter().find_map(|name| unknown_figure(name)) {
        return Err(scene.source.complain(Subject::Sheet, unknown, None).into());
    }
    let language = language(job, scene)?;
    let theme = theme(job, scene)?;
    let solved = crate::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene)
        .map_err(|error| failure(scene, &error))?;
    let construction = &solved.solution.construction;
    let names: Vec<&str> = if job.figure.is_empty() {
        scene.sheet.figures.iter().map(String::as_str).collect()
    } else {
        job.figure.iter().map(String::as_str).collect()
    };
    let figure = if names.is_empty() {
        sheet::solution(scene, construction, language)
    } else {
        sheet::stack(&singles(scene, construction, language, &names)?)
    };
    if figure.width > LARGEST_SHEET || figure.height > LARGEST_SHEET {
        let [width, height] = [figure.width, figure.height].map(|mm| short(mm / 1000.0));
        let what = format!("at the stated scales the sheet would be {width} m wide and {height} m high");
        let mend = "choose smaller scales; where none is stated the diagrams fill their panels".to_owned();
        return Err(scene.source.complain(Subject::Sheet, what, Some(mend)).into());
    }
    let options = render::Options { theme, lettering, dpi: job.dpi };
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
        Format::from_name(name).ok_or_else(|| Failure(unknown("format", name, &known)))
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
        let path = path.display();
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
    let kind = Lettering::from_name(name).ok_or_else(|| Failure(unknown("kind of text", name, &known)))?;
    if !formats.contains(&Format::Svg) {
        return Err(Failure(format!("--text {name} is for SVG, and none is written")));
    }
    Ok(kind)
}

fn theme(job: &Job, scene: &Scene) -> Result<Theme, Failure> {
    let Some(name) = job.theme.as_ref().or(scene.sheet.theme.as_ref()) else { return Ok(Theme::default()) };
    Theme::from_name(name).ok_or_else(|| Failure(unknown("theme", name, &Theme::ALL.map(Theme::name))))
}

fn unknown(what: &str, name: &str, known: &[&str]) -> String {
    let nearest = crate::scene::nearest(name, known);
    let mend = nearest.map_or(String::new(), |n| format!("; did you mean {n}?"));
    format!("unknown {what} {name}{mend} (known: {})", known.join(", "))
}

/// What is wrong with the name of a figure, if it is unknown.
fn unknown_figure(name: &str) -> Option<String> {
    let known = sheet::figure_names();
    if known.contains(&name) {
        return None;
    }
    Some(unknown("figure", name, known))
}

fn language(job: &Job, scene: &Scene) -> Result<sheet::Language, Failure> {
    let tag = job.lang.as_deref().or(scene.sheet.language.as_deref()).unwrap_or("en");
    sheet::Language::from_tag(tag).ok_or_else(|| {
        Failure(format!("language {tag} is not available; known: {}", sheet::Language::tags().join(", ")))
    })
}

fn singles(
    scene: &Scene,
    construction: &crate::graphical::construction::Construction,
    language: sheet::Language,
    names: &[&str],
) -> Result<Vec<Figure>, Failure> {
    names
        .iter()
        .map(|name| {
            sheet::single(scene, construction, name, language).ok_or_else(|| {
                Failure(format!("figure {name}: nothing asked in this scene needs it, so it is not drawn"))
            })
        })
        .collect()
}
