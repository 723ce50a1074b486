//! `linkgram draw`.

use std::path::{Path, PathBuf};

use super::report::short;
use super::{Ending, Failure, failure, files, print_bytes, read_scene};
use crate::graphical::Scales;
use crate::graphical::construction::Construction;
use crate::plan::{Auxiliary, Extent};
use crate::render::theme::Theme;
use crate::render::{self, Format, Lettering};
use crate::scene::{Scene, Subject};
use crate::sheet::{self, Figure};
use crate::solve::Settings;

/// No sheet is wider or higher, all its pages together (mm): scales stated by mistake, and a picture that
/// no program opens.
const LARGEST_SHEET: f64 = 100_000.0;

/// What is to be drawn, and where.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) output: Vec<PathBuf>,
    pub(super) figure: Vec<String>,
    pub(super) kind: Kind,
    pub(super) play: bool,
    pub(super) paper: Option<String>,
    pub(super) lang: Option<String>,
    pub(super) dpi: f32,
    pub(super) settings: Settings,
    pub(super) theme: Option<String>,
    pub(super) text: Option<String>,
    pub(super) format: Option<String>,
    pub(super) positions: Vec<String>,
    pub(super) other_assembly: bool,
}

/// What is drawn of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Kind {
    /// The dimensioned skeleton, what is given and what is asked
    Question,
    /// Everything
    Solution,
    /// One small figure per step
    Steps,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let formats = formats(job)?;
    let lettering = lettering(job, &formats)?;
    if job.play && job.kind != Kind::Steps {
        return Err(Failure("--play plays the steps: say --as steps as well".to_owned()));
    }
    if let Some(unknown) = job.figure.iter().find_map(|name| unknown_figure(name)) {
        return Err(Failure(unknown));
    }
    if !(job.dpi.is_finite() && (10.0..=2400.0).contains(&job.dpi)) {
        return Err(Failure(format!("--dpi {}: choose between 10 and 2400", job.dpi)));
    }
    let (_, mut scene) = read_scene(&job.scene)?;
    if let Some(paper) = &job.paper {
        let size = crate::scene::paper_size(paper);
        scene.sheet.paper = Some(size.ok_or_else(|| {
            Failure(format!("--paper {paper}: choose A0 to A6, letter or legal, such as \"A3 landscape\""))
        })?);
    }
    if job.positions.len() > crate::scene::MOST_POSITIONS {
        let most = crate::scene::MOST_POSITIONS;
        return Err(Failure(format!("--positions: {most} at most can be told apart")));
    }
    if !job.positions.is_empty() {
        let places = job.positions.iter().map(|text| crate::scene::input_place(text, &scene));
        let places = places.collect::<Result<Vec<f64>, String>>();
        scene.sheet.positions = places.map_err(|why| Failure(format!("--positions: {why}")))?;
    }
    scene.sheet.other_assembly |= job.other_assembly;
    let scene = &scene;
    if let Some(unknown) = scene.sheet.figures.iter().find_map(|name| unknown_figure(name)) {
        return Err(scene.source.complain(Subject::Sheet, unknown, None).into());
    }
    let language = language(job, scene)?;
    let options = render::Options { theme: theme(job, scene)?, lettering, dpi: job.dpi };
    // What the scene wishes to have drawn is a wish for the solution.
    let names: Vec<&str> = if job.figure.is_empty() && job.kind == Kind::Solution {
        scene.sheet.figures.iter().map(String::as_str).collect()
    } else {
        job.figure.iter().map(String::as_str).collect()
    };
    let scales = match job.kind {
        Kind::Question => sheet::scale::for_question,
        Kind::Steps => sheet::scale::for_steps,
        Kind::Solution => sheet::scale::for_scene,
    };
    let centres = names.iter().any(|name| ["centres", "circle"].contains(name));
    let extent = if centres { Extent::AllCentres } else { Extent::WholeSkeleton };
    let wanted = names.iter().filter_map(|name| sheet::auxiliary(name, scene).transpose());
    let auxiliary: Vec<Auxiliary> = wanted.collect::<Result<_, _>>().map_err(Failure)?;
    let solved = crate::solve::solve_with(scene, extent, &auxiliary, job.settings, scales)
        .map_err(|error| failure(scene, &error))?;
    let construction = &solved.solution.construction;
    let shown = Shown { scene, extent, language, settings: job.settings };
    let figure = match (job.kind, &names[..]) {
        (Kind::Question, []) => sheet::question(scene, construction, language),
        (Kind::Question, ["skeleton"]) => sheet::single_of_question(scene, construction, language),
        (Kind::Question, _) => {
            return Err(Failure(
                "--as question: the only figure that gives no answer away is skeleton".to_owned(),
            ));
        }
        (Kind::Steps, []) if job.play => {
            let frames = sheet::film(scene, construction, language);
            return write_film(job, &formats, &frames, &options);
        }
        (Kind::Steps, []) => sheet::step_by_step(scene, construction, language),
        (Kind::Steps, _) => {
            return Err(Failure("--as steps draws all figures; leave out --figure".to_owned()));
        }
        (_, []) => sheet::solution(scene, construction, language),
        (_, names) => sheet::stack(&shown.singles(construction, names)?),
    };
    if figure.width > LARGEST_SHEET || figure.height > LARGEST_SHEET {
        let [width, height] = [figure.width, figure.height].map(|mm| short(mm / 1000.0));
        let what = format!("at the stated scales the sheet would be {width} m wide and {height} m high");
        let mend = "choose smaller scales; where none is stated the diagrams fill their panels".to_owned();
        return Err(scene.source.complain(Subject::Sheet, what, Some(mend)).into());
    }
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
    let kind =
        Lettering::from_name(name).ok_or_else(|| Failure(unknown("kind of text", name, name, &known)))?;
    if !formats.contains(&Format::Svg) {
        return Err(Failure(format!("--text {name} is for SVG, and none is written")));
    }
    Ok(kind)
}

fn theme(job: &Job, scene: &Scene) -> Result<Theme, Failure> {
    let Some(name) = job.theme.as_ref().or(scene.sheet.theme.as_ref()) else { return Ok(Theme::default()) };
    Theme::from_name(name).ok_or_else(|| Failure(unknown("theme", name, name, &Theme::ALL.map(Theme::name))))
}

/// That `name` is unknown, and what comes nearest to its `head`, the part that is looked up.
fn unknown(what: &str, name: &str, head: &str, known: &[&str]) -> String {
    let nearest = crate::scene::nearest(head, known);
    let mend = nearest.map_or(String::new(), |n| format!("; did you mean {n}?"));
    format!("unknown {what} {name}{mend} (known: {})", known.join(", "))
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
        return Err(Failure(format!("{}: only SVG plays; end the name in .svg", path.display())));
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

/// What is wrong with the name of a figure, if it is unknown.
fn unknown_figure(name: &str) -> Option<String> {
    let known = sheet::figure_names();
    let head = sheet::figure_head(name);
    if known.contains(&head) {
        return None;
    }
    Some(unknown("figure", name, head, known))
}

fn language(job: &Job, scene: &Scene) -> Result<sheet::Language, Failure> {
    let tag = job.lang.as_deref().or(scene.sheet.language.as_deref()).unwrap_or("en");
    sheet::Language::from_tag(tag).ok_or_else(|| {
        Failure(format!("language {tag} is not available; known: {}", sheet::Language::tags().join(", ")))
    })
}

/// What every single figure of a run has in common.
struct Shown<'a> {
    scene: &'a Scene,
    extent: Extent,
    language: sheet::Language,
    settings: Settings,
}

impl Shown<'_> {
    fn singles(&self, construction: &Construction, names: &[&str]) -> Result<Vec<Figure>, Failure> {
        names.iter().map(|name| self.single(construction, name)).collect()
    }

    fn single(&self, construction: &Construction, name: &str) -> Result<Figure, Failure> {
        let scene = self.scene;
        let kind = sheet::auxiliary(name, scene).ok().flatten();
        let drawing = construction.auxiliary.iter().find(|a| Some(a.kind) == kind);
        // A construction that outgrows the sheet is drawn once more to a scale of its own.
        let smaller = drawing.filter(|_| scene.sheet.length_scale.is_none());
        let smaller = smaller.and_then(|drawing| sheet::scale::for_auxiliary(construction, drawing));
        let again = smaller.zip(kind).map(|(length, kind)| {
            let choose =
                |scene: &Scene, extents| Scales { length, ..sheet::scale::for_scene(scene, extents) };
            crate::solve::solve_with(scene, self.extent, &[kind], self.settings, choose)
                .map_err(|error| failure(scene, &error))
        });
        let again = again.transpose()?;
        let construction = again.as_ref().map_or(construction, |solved| &solved.solution.construction);
        sheet::single(scene, construction, name, self.language).ok_or_else(|| {
            let why = drawing.and_then(|drawing| drawing.refused);
            let why = why.unwrap_or("nothing asked in this scene needs it, so it is not drawn");
            Failure(format!("figure {name}: {why}"))
        })
    }
}
