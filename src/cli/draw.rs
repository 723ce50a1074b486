//! `linkgram draw`.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use super::arguments::{self, Against};
use super::{Ending, Failure, print_bytes, read_scene};
use crate::check::confirm_sweep;
use crate::drawing::{self, Kind, NoFigure, Wish, unknown, unknown_figure};
use crate::files;
use crate::live::{self, Live, LiveError};
use crate::plan::Extent;
use crate::render::theme::Theme;
use crate::render::{self, Format, Lettering};
use crate::scene::Scene;
use crate::sheet::{self, Figure, Language};
use crate::solve::{Arithmetic, Settings, solve_with};
use crate::sweep::Over;

/// What is to be drawn, and where.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file; - for standard input
    pub(super) scene: PathBuf,
    /// Where to write; the ending chooses the format (.svg, .png, .pdf, .tex, .json, .html); may be given
    /// several times: all files are written, or none. Without it the figure goes to standard output
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// A single figure instead of the sheet: skeleton, velocity, acceleration, steps, results
    #[arg(long, value_name = "NAME")]
    pub(super) figure: Vec<String>,
    /// What to draw: the question without its answers, the solution, or its steps one by one
    #[arg(long = "as", value_name = "KIND", value_enum, default_value_t = Kind::Solution)]
    pub(super) kind: Kind,
    /// With --as steps: one SVG that plays them, without a script; an HTML page plays by itself, without this option
    #[arg(long)]
    pub(super) play: bool,
    /// Paper: A0 to A6, letter or legal, with " landscape" after it if wanted
    #[arg(long, value_name = "SIZE")]
    pub(super) paper: Option<String>,
    /// Language of the sheet: en, ar, ar-x-ajala, fa; of a page several: en,ar,fa
    #[arg(long, value_name = "LANG")]
    pub(super) lang: Option<String>,
    /// Resolution of a PNG: 150 where nothing is said
    #[arg(long, value_name = "DPI", allow_negative_numbers = true)]
    pub(super) dpi: Option<f32>,
    /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
    #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = arguments::arithmetic)]
    pub(super) arith: Arithmetic,
    /// Colours: mono, colour or dark; what the scene says, or mono
    #[arg(long, value_name = "NAME")]
    pub(super) theme: Option<String>,
    /// Text of an SVG: embed (with the glyphs that it uses), live (for those who have the typefaces) or outline
    /// (paths); embed where nothing is said
    #[arg(long, value_name = "KIND")]
    pub(super) text: Option<String>,
    /// Format on standard output: svg, png, pdf, tex, json or html
    #[arg(long, value_name = "FORMAT")]
    pub(super) format: Option<String>,
    /// Other positions, dashed on the skeleton: places of the input, such as 60,90 or "1 rad,2 rad"
    #[arg(long, value_name = "LIST", value_delimiter = ',', allow_hyphen_values = true)]
    pub(super) positions: Vec<String>,
    /// The other assembly, dashed on the skeleton
    #[arg(long)]
    pub(super) other_assembly: bool,
    /// Draw it even where the independent solver does not confirm it, with a note that says so
    #[arg(long)]
    pub(super) unchecked: bool,
    /// Of a page (.html): what moves it, the input or time
    #[arg(long, value_enum, default_value_t = Against::Input)]
    pub(super) against: Against,
    /// Of a page: from this place of the input, in the scene's unit
    #[arg(long, value_name = "AT", allow_hyphen_values = true)]
    pub(super) from: Option<f64>,
    /// Of a page: to this place of the input
    #[arg(long, value_name = "AT", allow_hyphen_values = true)]
    pub(super) to: Option<f64>,
}

impl Job {
    fn settings(&self) -> Settings {
        Settings { arithmetic: self.arith, unchecked: self.unchecked }
    }
}

/// Seconds for the course of a page where nothing is said.
const SECONDS: f64 = 6.0;

/// What is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Output {
    Figure(Format),
    /// A page of hypertext.
    Page,
}

impl Output {
    fn from_name(name: &str) -> Option<Self> {
        let page = ["html", "htm"].iter().any(|known| name.eq_ignore_ascii_case(known));
        if page { Some(Self::Page) } else { Format::from_name(name).map(Self::Figure) }
    }

    /// The names of all, pages last.
    fn names() -> Vec<&'static str> {
        Format::ALL.map(Format::name).into_iter().chain(["html"]).collect()
    }
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let outputs = outputs(job)?;
    let formats: Vec<Format> = outputs
        .iter()
        .filter_map(|output| match output {
            Output::Figure(format) => Some(*format),
            Output::Page => None,
        })
        .collect();
    let pages = outputs.contains(&Output::Page);
    if !pages && (job.against.over() != Over::Input || job.from.is_some() || job.to.is_some()) {
        let what = "--against, --from and --to are for a page that moves: end a name in .html";
        return Err(Failure(what.to_owned()));
    }
    let languages = languages(job, pages)?;
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
        language: languages.first().copied(),
        settings: job.settings(),
    };
    let options = render::Options { theme: theme(job, scene)?, lettering, dpi };
    let impossible = |error: NoFigure| match error {
        NoFigure::Unconfirmed(_) => Failure::unconfirmed(error.told(scene)),
        _ => Failure(error.told(scene)),
    };
    if job.play && pages {
        return Err(Failure("--play plays in an SVG; a page plays by itself: leave it out".to_owned()));
    }
    if job.play {
        let film = drawing::film(scene, &wish).map_err(impossible)?;
        write_film(job, &formats, &film.frames, &options)?;
        return Ok(ending(scene, &film.indeterminate));
    }
    let drawn = drawing::drawn(scene, &wish).map_err(impossible)?;
    let figure = drawn.figure;
    if let Some([width, height]) = sheet::larger_paper(&figure, sheet::paper(scene)) {
        let file = scene.source.file();
        let line = format!("{file}: the stated scales need larger paper: {width:.0} × {height:.0} mm");
        let _ = writeln!(io::stderr(), "{}", crate::terminal::lines(&line));
    }
    let page = if pages {
        let first = languages.first().copied().unwrap_or_else(|| drawing::language(scene));
        let mut sheets = vec![(first, figure.clone())];
        for language in languages.iter().skip(1) {
            let wish = Wish { language: Some(*language), ..wish.clone() };
            sheets.push((*language, drawing::figure(scene, &wish).map_err(impossible)?));
        }
        Some(page(job, scene, sheets)?)
    } else {
        None
    };
    let bytes = |output: &Output| match output {
        Output::Figure(format) => {
            render::render(&figure, *format, &options).map_err(|error| super::not_written(scene, &error))
        }
        Output::Page => Ok(page.clone().unwrap_or_default().into_bytes()),
    };
    if job.output.is_empty() {
        for output in &outputs {
            print_bytes(&bytes(output)?)?;
        }
        return Ok(ending(scene, &drawn.indeterminate));
    }
    let mut written = Vec::new();
    for (path, output) in job.output.iter().zip(&outputs) {
        written.push((path.clone(), bytes(output)?));
    }
    files::write_all(&written)?;
    Ok(ending(scene, &drawn.indeterminate))
}

/// What is asked and not determined is said, and no success.
fn ending(scene: &Scene, indeterminate: &[(String, String)]) -> Ending {
    let file = scene.source.file();
    for (name, why) in indeterminate {
        let line = format!("{file}: {name} is indeterminate: {why}");
        let _ = writeln!(io::stderr(), "{}", crate::terminal::lines(&line));
    }
    if indeterminate.is_empty() { Ending::Fine } else { Ending::DoesNotHold }
}

/// The page of a scene: with what moves, or without and a warning that says why.
fn page(job: &Job, scene: &Scene, sheets: Vec<(Language, Figure)>) -> Result<String, Failure> {
    let options = live::Options { sheets, seconds: SECONDS };
    if job.kind == Kind::Question {
        return Ok(live::question(scene, &options));
    }
    let failed = |error: LiveError| Failure(error.to_string());
    let solved = solve_with(scene, Extent::WholeSkeleton, &[], job.settings(), sheet::scale::for_scene)
        .map_err(|error| super::failure(scene, &error))?;
    let unit = super::sweep::unit_of(scene, job.against.over());
    let range = match (job.from, job.to) {
        (None, None) => None,
        (Some(from), Some(to)) => Some([from * unit.si, to * unit.si]),
        _ => return Err(Failure("give both --from and --to, in the scene's units".to_owned())),
    };
    let live = match Live::of_solved(scene, &solved, job.against.over(), range) {
        // A range that is none is the caller's mistake, not the mechanism's.
        Err(error @ LiveError::Sweep(crate::sweep::SweepError::Range(_))) => return Err(failed(error)),
        // With the scene's own units; where the scene's file lies is no matter of those who read the page.
        Err(LiveError::Sweep(crate::sweep::SweepError::Draw(error))) => {
            Err(crate::report::diagnose(scene, &crate::solve::SolveError::Draw(error)).what)
        }
        Err(error) => Err(error.to_string()),
        Ok(live) => match confirm_sweep(live.sweep()) {
            Ok(_) => Ok(live),
            Err(why) => Err(super::sweep::not_confirmed(scene, live.sweep(), &unit, &why)),
        },
    };
    let (page, still) =
        live::page(scene, &solved, live.as_ref().map_err(Clone::clone), &options).map_err(failed)?;
    if let Some(why) = still {
        let file = scene.source.file();
        let _ = writeln!(io::stderr(), "{file}: the page does not move: {why}");
    }
    Ok(page)
}

/// What each output is; standard output where there is none.
fn outputs(job: &Job) -> Result<Vec<Output>, Failure> {
    let chosen = |name: &String| {
        Output::from_name(name).ok_or_else(|| Failure(unknown("format", name, name, &Output::names())))
    };
    if job.output.is_empty() {
        let chosen = job.format.as_ref().map(chosen).transpose()?;
        return Ok(vec![chosen.unwrap_or(Output::Figure(Format::default()))]);
    }
    if job.format.is_some() {
        let what = "--format is for standard output; the ending of a file's name chooses its format";
        return Err(Failure(what.to_owned()));
    }
    job.output.iter().map(|path| format_of(path)).collect()
}

fn format_of(path: &Path) -> Result<Output, Failure> {
    let ending = path.extension().and_then(|e| e.to_str()).and_then(Output::from_name);
    ending.ok_or_else(|| {
        let known: Vec<String> = Output::names().into_iter().map(|name| format!(".{name}")).collect();
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

/// The languages that are asked for: several for a page.
fn languages(job: &Job, pages: bool) -> Result<Vec<Language>, Failure> {
    let Some(tags) = &job.lang else { return Ok(Vec::new()) };
    let mut all = Vec::new();
    for tag in tags.split(',').map(str::trim) {
        let language = super::language(tag)?;
        if !all.contains(&language) {
            all.push(language);
        }
    }
    if all.len() > 1 && !pages {
        return Err(Failure(format!("--lang {tags}: several languages are for a page: end a name in .html")));
    }
    Ok(all)
}

/// Writes the steps as a film.
fn write_film(
    job: &Job,
    formats: &[Format],
    frames: &[Figure],
    options: &render::Options,
) -> Result<(), Failure> {
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
        return Ok(());
    }
    let written: Vec<_> = job.output.iter().map(|path| (path.clone(), svg.clone().into_bytes())).collect();
    files::write_all(&written)?;
    Ok(())
}
