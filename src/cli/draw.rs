//! `linkgram draw`.

use std::path::{Path, PathBuf};

use super::{Ending, Failure, failure, files, print, read_scene};
use crate::plan::Extent;
use crate::scene::Scene;
use crate::sheet::{self, Figure};

/// What is to be drawn, and where.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) output: Vec<PathBuf>,
    pub(super) figure: Vec<String>,
    pub(super) lang: Option<String>,
    pub(super) dpi: f32,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let formats: Vec<Format> = job.output.iter().map(|path| Format::of(path)).collect::<Result<_, _>>()?;
    for name in &job.figure {
        if !sheet::figure_names().contains(&name.as_str()) {
            let nearest = crate::scene::nearest(name, sheet::figure_names());
            let mend = nearest.map_or(String::new(), |n| format!("; did you mean {n}?"));
            let known = sheet::figure_names().join(", ");
            return Err(Failure(format!("unknown figure {name}{mend} (known: {known})")));
        }
    }
    if !(job.dpi.is_finite() && (10.0..=2400.0).contains(&job.dpi)) {
        return Err(Failure(format!("--dpi {}: choose between 10 and 2400", job.dpi)));
    }
    let (_, scene) = read_scene(&job.scene)?;
    let scene = &scene;
    let language = language(job, scene)?;
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
    let svg = crate::render::svg::write(&figure);
    if job.output.is_empty() {
        print(&svg)?;
        return Ok(Ending::Fine);
    }
    let mut written = Vec::new();
    for (path, format) in job.output.iter().zip(&formats) {
        let bytes = match format {
            Format::Svg => svg.clone().into_bytes(),
            Format::Png => png(&figure, job.dpi)?,
        };
        written.push((path.clone(), bytes));
    }
    files::write_all(&written)?;
    Ok(Ending::Fine)
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

#[cfg(feature = "png")]
fn png(figure: &Figure, dpi: f32) -> Result<Vec<u8>, Failure> {
    crate::render::png::render(figure, dpi).map_err(|error| Failure(error.to_string()))
}

#[cfg(not(feature = "png"))]
fn png(_: &Figure, _: f32) -> Result<Vec<u8>, Failure> {
    Err(Failure("this build has no PNG: build with the feature `png`".to_owned()))
}

#[derive(Debug, Clone, Copy)]
enum Format {
    Svg,
    Png,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase).as_deref() {
            Some("svg") => Ok(Self::Svg),
            Some("png") => Ok(Self::Png),
            _ => Err(Failure(format!("{}: unknown format; end the name in .svg or .png", path.display()))),
        }
    }
}
