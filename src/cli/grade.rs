//! `linkgram grade`.

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use super::{Ending, Failure, arguments, failure, print, progress, read_scene};
use crate::files;
use crate::grade::{self, Allowed, GradeError, GradeSettings, HandIn, Report};
use crate::parallel;
use crate::render::theme::Theme;
use crate::render::{self, Format, Lettering};
use crate::scene::{Diagnostic, Scene};
use crate::sheet::{self, Figure, Language};
use crate::solve::Hand;

/// What is to be graded, and how.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file; - for standard input
    pub(super) scene: PathBuf,
    /// What was handed in: JSON, CSV or SVG (linkgram schema answers), of one or of a whole class; - for
    /// standard input. Without any: by how much each answer may be off
    pub(super) answers: Vec<PathBuf>,
    /// The SVG of the drawing, instead of the one that the answers name; without answers it is all that was handed in
    #[arg(long, value_name = "FILE")]
    pub(super) drawing: Option<PathBuf>,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// By how many millimetres of paper lengths and readings may slip, and by how many degrees directions;
    /// 0.2mm,0.3deg where nothing is said, and for the variants of an exam what the exam was made with
    #[arg(long, value_name = "MM,DEG", allow_hyphen_values = true, value_parser = arguments::hand)]
    pub(super) hand: Option<Hand>,
    /// No answer may be off by a larger part of the right value; 10% where nothing is said, and for the variants of an exam what the exam was made with
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = arguments::percent)]
    pub(super) max_tolerance: Option<f64>,
    /// The answers are the examiner's own, such as a textbook's: the `tolerance` that they state counts, uncapped.
    /// Without this it does not
    #[arg(long)]
    pub(super) trust_answers: bool,
    /// Language of the reports: en, ar, ar-x-ajala, fa; that of the scene's sheet where nothing is said
    #[arg(long, value_name = "LANG")]
    pub(super) lang: Option<String>,
    /// Where to write the student's polygons over the right ones, every fault circled; the ending chooses the
    /// format, .html is a page with report and figure. A folder: a page for each, marks.csv and faults.csv
    #[arg(short, long, value_name = "FILE|DIR")]
    pub(super) output: Option<PathBuf>,
}

/// What is written.
enum Output {
    Overlay(PathBuf, Format),
    Page(PathBuf),
    /// A page for each, and the tables of the class.
    Folder(PathBuf),
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    if job.max_tolerance.is_some_and(|most| most <= 0.0) {
        return Err(Failure("--max-tolerance: a tolerance is greater than zero".to_owned()));
    }
    let (answers, drawing) = match &job.drawing {
        Some(alone) if job.answers.is_empty() => (std::slice::from_ref(alone), None),
        drawing => (job.answers.as_slice(), drawing.as_deref()),
    };
    if answers.len() > 1 && drawing.is_some() {
        return Err(Failure(
            "--drawing is that of one student; name it in the answers, as `drawing`".to_owned(),
        ));
    }
    let class = answers.len() > 1;
    let output = job.output.as_deref().map(|path| output(path, class)).transpose()?;
    if !matches!(output, Some(Output::Folder(_))) && !job.scene.is_dir() {
        files::spare(&job.scene, &job.output)?;
        for handed_in in answers.iter().map(PathBuf::as_path).chain(drawing) {
            files::spare_input("what was handed in", handed_in, &job.output)?;
        }
    }
    let standard_inputs =
        [&job.scene].into_iter().chain(answers).filter(|path| path.as_os_str() == "-").count();
    if standard_inputs > 1 {
        return Err(Failure("scene and answers cannot both be standard input".to_owned()));
    }
    let exam = job.scene.is_dir().then(|| Exam::new(&job.scene));
    if let (Some(exam), true) = (&exam, answers.is_empty()) {
        let why = "no answers; name the files that were handed in";
        return Err(Failure(format!("{}: {why}", files::shown(&exam.folder))));
    }
    // Whoever handed in is graded as the key of the exam was made.
    let mut settings = exam.as_ref().map_or(Ok(GradeSettings::default()), Exam::settings)?;
    if let Some(most) = job.max_tolerance {
        settings.max_tolerance = most;
    }
    settings.trusts_answers = job.trust_answers;
    settings.printed = matches!(output, Some(Output::Page(_) | Output::Folder(_)));
    if let Some(hand) = job.hand {
        settings.hand = hand;
    }
    let source = match exam {
        Some(exam) => Source::Exam(exam),
        None => {
            let scene = read_scene(&job.scene)?.1;
            Source::Scene(Box::new(scene))
        }
    };
    if let (true, Source::Scene(scene)) = (answers.is_empty(), &source) {
        return tolerances(job, scene, &settings);
    }
    if class {
        return of_class(job, &source, &settings, answers, output.as_ref());
    }
    let Some(own) = answers.first() else { return Ok(Ending::Fine) };
    let scene = source.of(own)?;
    let settings = GradeSettings { language: language(job, &scene)?, ..settings };
    let (report, figure) = graded((&scene, &source), own, drawing, &settings, false)?;
    match &output {
        None => {}
        Some(Output::Overlay(path, format)) => {
            let Some(figure) = figure else {
                return Err(Failure(format!(
                    "{}: no answer needs a polygon, so there is nothing to lay over",
                    files::shown(path)
                )));
            };
            let options = render::Options { lettering: Lettering::portable(), ..render::Options::default() };
            let bytes =
                render::render(&figure, *format, &options).map_err(|error| Failure(error.to_string()))?;
            files::write_all(&[(path.clone(), bytes)])?;
        }
        Some(Output::Page(path)) => {
            files::write_all(&[(
                path.clone(),
                page(&title(&scene, report.language), &report, figure.as_ref())?,
            )])?;
        }
        Some(Output::Folder(folder)) => {
            let one = HandIn { file: files::shown(own), outcome: Ok(report.clone()) };
            write_folder(
                folder,
                answers,
                &[one],
                &[figure.map(|figure| (title(&scene, report.language), figure))],
            )?;
        }
    }
    if job.json {
        let text =
            serde_json::to_string_pretty(&report.to_json()).map_err(|error| Failure(error.to_string()))?;
        print(&(text + "\n"))?;
    } else {
        print(&report.to_text())?;
    }
    // What is not understood is told like any bad input, behind what was graded all the same.
    let unread = unread(&report);
    if !unread.is_empty() {
        return Err(Failure(unread.join("\nerror: ")));
    }
    Ok(if report.holds() { Ending::Fine } else { Ending::DoesNotHold })
}

/// What of a hand-in is not understood.
fn unread(report: &Report) -> Vec<String> {
    report.not_read.iter().map(|one| one.why.to_string()).collect()
}

/// What is graded by: a scene, or the variants of an exam.
enum Source {
    Scene(Box<Scene>),
    Exam(Exam),
}

/// The folder of an exam.
struct Exam {
    folder: PathBuf,
    /// What is right of every variant; nothing where the key is not there.
    key: grade::Key,
}

impl Source {
    /// The scene that somebody has solved.
    fn of(&self, answers: &Path) -> Result<Scene, Failure> {
        match self {
            Self::Scene(scene) => Ok((**scene).clone()),
            Self::Exam(exam) => exam.variant_of(answers),
        }
    }
}

impl Exam {
    fn new(folder: &Path) -> Self {
        let key = files::read_file(&folder.join("key.json")).ok();
        let key = key.and_then(|(_, text)| grade::Key::read(&text)).unwrap_or_default();
        Self { folder: folder.to_owned(), key }
    }

    /// As the key was made; sense and direction have their part of the marks.
    fn settings(&self) -> Result<GradeSettings, Failure> {
        let path = self.folder.join("exam.json");
        let (file, text) = files::read_file(&path)?;
        let damaged = || Failure(format!("{file}: not the manifest of an exam"));
        let manifest: serde_json::Value = serde_json::from_str(&text).map_err(|_| damaged())?;
        let number = |value: &serde_json::Value| value.as_f64().filter(|x| *x > 0.0).ok_or_else(damaged);
        let hand = Hand {
            length: number(&manifest["hand"]["length_mm"])?,
            angle: number(&manifest["hand"]["angle_deg"])?.to_radians(),
        };
        let max_tolerance = number(&manifest["max_tolerance"])?;
        Ok(GradeSettings { hand, max_tolerance, by_parts: true, ..GradeSettings::default() })
    }

    /// The variant that the answers name, or after which their file is named.
    fn variant_of(&self, answers: &Path) -> Result<Scene, Failure> {
        let (file, text) = files::read_file(answers)?;
        let text = grade::with_plain_digits(&text);
        let begin = text.trim_start_matches('\u{feff}').trim_start();
        if begin.is_empty() {
            return Err(Failure(format!("{file}: the file is empty")));
        }
        let json =
            || Some(serde_json::from_str::<serde_json::Value>(&text).ok()?["variant"].as_str()?.to_owned());
        let row = || {
            let rows = text.lines().filter_map(|line| line.split_once([',', ';']));
            let mut own = rows.filter(|(key, _)| key.trim().eq_ignore_ascii_case("variant"));
            own.next().map(|(_, value)| value.trim_matches([' ', ',', ';', '"', '\r']).to_owned())
        };
        let named = || {
            let stem = answers.file_stem()?.to_str()?;
            let stem = grade::with_plain_digits(stem);
            let digits: String = stem.chars().take_while(char::is_ascii_digit).collect();
            (digits.len() == 3).then_some(digits)
        };
        let variant = json()
            .or_else(row)
            .or_else(named)
            .filter(|name| !name.is_empty() && name.len() <= 6 && name.chars().all(|c| c.is_ascii_digit()));
        let Some(variant) = variant else {
            if begin.starts_with('{') {
                grade::refuse_broken(&text, &file)?;
            }
            return Err(Failure(format!(
                "{file}: which variant is this? say \"variant\": \"007\", in a table the row `variant,007`, or name \
                 the file after it"
            )));
        };
        let path = self.folder.join("scenes").join(format!("{variant:0>3}.json"));
        if !path.is_file() {
            let exam = files::shown(&self.folder);
            return Err(Failure(format!("{file}: {exam} has no variant {variant}")));
        }
        Ok(read_scene(&path)?.1)
    }
}

fn title(scene: &Scene, language: Language) -> String {
    let words = language.words();
    scene.title.in_language(words.tag).unwrap_or(words.untitled).to_owned()
}

/// The language of the reports: as it is wished, or that of the sheet.
fn language(job: &Job, scene: &Scene) -> Result<Language, Failure> {
    let own = || scene.sheet.language.as_deref().and_then(Language::from_tag).unwrap_or_default();
    job.lang.as_deref().map_or_else(|| Ok(own()), super::language)
}

/// What an output's name means.
fn output(path: &Path, class: bool) -> Result<Output, Failure> {
    let named_folder = path.to_str().is_some_and(|text| text.ends_with(['/', '\\']));
    let ending = path.extension().and_then(|e| e.to_str());
    if path.is_dir() || named_folder || (class && ending.is_none()) {
        return Ok(Output::Folder(path.to_owned()));
    }
    if class {
        return Err(Failure(format!(
            "{}: several hand-ins have a folder of reports; end its name in /",
            files::shown(path)
        )));
    }
    if ending.is_some_and(|ending| ending.eq_ignore_ascii_case("html")) {
        return Ok(Output::Page(path.to_owned()));
    }
    match ending.and_then(Format::from_name) {
        Some(format) => Ok(Output::Overlay(path.to_owned(), format)),
        None => Err(Failure(format!(
            "{}: unknown format; end the name in .svg, .html, or in / for a folder of reports",
            files::shown(path)
        ))),
    }
}

/// Reads and grades what one student handed in.
fn graded(
    (scene, source): (&Scene, &Source),
    path: &Path,
    drawing: Option<&Path>,
    settings: &GradeSettings,
    of_class: bool,
) -> Result<(Report, Option<Figure>), Failure> {
    let (file, text) = files::read(path)?;
    let mut answers = grade::read_named(&text, &file, scene)?;
    // Where nobody says on the command line which drawing it is, it lies beside the answers.
    match (drawing, answers.drawing.clone()) {
        (Some(given), _) => {
            let (file, svg) = files::read_file(given)?;
            answers.add_drawing(&svg, &file, scene)?;
        }
        (None, Some(named)) => {
            // Whoever names what is no drawing has his other answers graded.
            if let Err(why) = add_drawing_beside(path, &named, &mut answers, scene) {
                if answers.is_empty() {
                    return Err(why.into());
                }
                answers.miss_drawing(why);
            }
        }
        (None, None) => {}
    }
    // Of a class somebody may hand in an empty sheet.
    if answers.is_empty() && !of_class {
        return Err(Failure(format!(
            "{file}: no answers: give `values`, `lengths`, `points` or a `drawing`"
        )));
    }
    if let (Source::Exam(exam), Some(own)) = (source, Path::new(scene.source.file()).file_stem()) {
        answers.other_variant = exam.key.other_variant(&answers, &own.to_string_lossy());
    }
    grade::grade_with_overlay(scene, &answers, settings).map_err(|error| refused(scene, error))
}

fn refused(scene: &Scene, error: GradeError) -> Failure {
    match error {
        GradeError::Solve(error) => failure(scene, &error),
        GradeError::Unconfirmed(why) => {
            Failure::unconfirmed(format!("{}: not confirmed, nothing is graded: {why}", scene.source.file()))
        }
        GradeError::Answers(diagnostic) => diagnostic.into(),
    }
}

/// By how much each asked quantity may be off: for whoever makes the problem.
fn tolerances(job: &Job, scene: &Scene, settings: &GradeSettings) -> Result<Ending, Failure> {
    if let Some(path) = &job.output {
        let why = "nothing was handed in, so there is nothing to lay over";
        return Err(Failure(format!("{}: {why}", files::shown(path))));
    }
    let language = language(job, scene)?;
    let all = grade::tolerances(scene, settings).map_err(|error| refused(scene, error))?;
    let loose = |graded: &grade::Graded| matches!(graded.allowed, Allowed::Capped { .. });
    let over_cap = |graded: &grade::Graded| matches!(graded.allowed, Allowed::Small { .. });
    if job.json {
        let told: Vec<serde_json::Value> = all
            .iter()
            .map(|graded| {
                serde_json::json!({
                    "name": graded.name, "unit": graded.unit.symbol, "right": graded.right,
                    "tolerance": graded.tolerance, "tolerance_direction_deg": graded.turn,
                    "tolerance_because": graded.because().told(language),
                    "loose": loose(graded), "over_cap": over_cap(graded),
                })
            })
            .collect();
        let told = serde_json::json!({ "tolerances": told, "ok": !all.iter().any(loose) });
        let text = serde_json::to_string_pretty(&told).map_err(|error| Failure(error.to_string()))?;
        print(&(text + "\n"))?;
    } else {
        let mut text = String::new();
        for graded in &all {
            let flag = match (loose(graded), over_cap(graded)) {
                (true, _) => "  TOO LOOSE: ask for something else, or draw larger",
                (false, true) => "  MORE THAN THE CAP",
                (false, false) => "",
            };
            let [right, because] =
                [graded.expected_within(), graded.because()].map(|told| told.told(language));
            let _ = writeln!(text, "{}: {right}: {because}{flag}", graded.name);
        }
        print(&text)?;
    }
    Ok(if all.iter().any(loose) { Ending::DoesNotHold } else { Ending::Fine })
}

/// Grades a class: what cannot be read is told, and the others are graded all the same.
fn of_class(
    job: &Job,
    source: &Source,
    settings: &GradeSettings,
    answers: &[PathBuf],
    output: Option<&Output>,
) -> Result<Ending, Failure> {
    let bar = progress(answers.len(), "hand-ins");
    let all = parallel::map(answers, |path| {
        let graded = source.of(path).and_then(|scene| {
            let language = language(job, &scene)?;
            let settings = GradeSettings { language, ..*settings };
            let (report, figure) = graded((&scene, source), path, None, &settings, true)?;
            Ok::<_, Failure>((report, figure.map(|figure| (title(&scene, language), figure))))
        });
        bar.inc(1);
        graded
    });
    bar.finish_and_clear();
    let mut class = Vec::new();
    let mut figures = Vec::new();
    for (path, outcome) in answers.iter().zip(all) {
        let (outcome, figure) = match outcome {
            Ok((report, figure)) => (Ok(report), figure),
            Err(failure) => (Err(failure.told), None),
        };
        class.push(HandIn { file: files::shown(path), outcome });
        figures.push(figure);
    }
    let refused: Vec<&str> =
        class.iter().filter_map(|one| one.outcome.as_ref().err()).map(String::as_str).collect();
    // Where none can be graded, the scene is at fault, or all of them.
    if refused.len() == class.len() {
        return Err(Failure(refused.join("\nerror: ")));
    }
    if let Some(Output::Folder(folder)) = output {
        write_folder(folder, answers, &class, &figures)?;
    }
    let faults = grade::class_faults(&class);
    if job.json {
        let students: Vec<serde_json::Value> = class
            .iter()
            .map(|one| match &one.outcome {
                Ok(report) => serde_json::json!({ "file": one.file, "report": report.to_json() }),
                Err(why) => serde_json::json!({ "file": one.file, "not_graded": why }),
            })
            .collect();
        let counted: Vec<serde_json::Value> = faults
            .iter()
            .map(
                |f| serde_json::json!({ "kind": f.kind, "at": f.at, "text": f.text, "students": f.students }),
            )
            .collect();
        let told = serde_json::json!({ "students": students, "faults": counted });
        let text = serde_json::to_string_pretty(&told).map_err(|error| Failure(error.to_string()))?;
        print(&(text + "\n"))?;
    } else {
        print(&told(&class, &faults))?;
    }
    let unread: Vec<String> = class
        .iter()
        .flat_map(|one| one.outcome.as_ref().map_or_else(|why| vec![why.clone()], unread))
        .collect();
    if !unread.is_empty() {
        return Err(Failure(unread.join("\nerror: ")));
    }
    let holds = class.iter().all(|one| one.outcome.as_ref().is_ok_and(Report::holds));
    Ok(if holds { Ending::Fine } else { Ending::DoesNotHold })
}

/// The class as a table, and its faults.
fn told(class: &[HandIn], faults: &[grade::ClassFault]) -> String {
    let name = |one: &HandIn| {
        let student = one.outcome.as_ref().ok().and_then(|report| report.student.clone());
        student.map_or_else(|| one.file.clone(), |student| format!("{student} ({})", one.file))
    };
    let width = class.iter().map(|one| name(one).chars().count()).max().unwrap_or(0);
    let mut text = String::new();
    for one in class {
        let name = name(one);
        match &one.outcome {
            Ok(report) => {
                let (reached, of) = report.sum();
                let fault = match (&report.other_variant, report.first_fault()) {
                    (Some(variant), _) => format!("the answers of variant {variant}"),
                    (None, fault) => {
                        let told = |fault: grade::FirstFault<'_>| fault.text().told(report.language);
                        fault.map_or(String::new(), |fault| report.symbols.plain(&told(fault)))
                    }
                };
                let marks = format!("{} of {}", short(reached), short(of));
                let _ = writeln!(text, "{name:<width$}  {marks:>10}  {fault}");
            }
            Err(_) => {
                let _ = writeln!(text, "{name:<width$}  not graded");
            }
        }
    }
    let graded: Vec<(f64, f64)> =
        class.iter().filter_map(|one| one.outcome.as_ref().ok()).map(Report::sum).collect();
    let (reached, of) = graded.iter().fold((0.0, 0.0), |(a, b), (reached, of)| (a + reached, b + of));
    if of > 0.0 {
        let _ = writeln!(text, "{} graded, {:.0} % of the marks reached", graded.len(), 100.0 * reached / of);
    }
    for fault in faults {
        let students = if fault.students == 1 { "student" } else { "students" };
        let _ = writeln!(text, "{} {students}: {}", fault.students, fault.text);
    }
    text
}

fn short(value: f64) -> String {
    let text = format!("{value:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Writes a page for each who was graded, and the tables of the class: all of them, or none.
fn write_folder(
    folder: &Path,
    answers: &[PathBuf],
    class: &[HandIn],
    figures: &[Option<(String, Figure)>],
) -> Result<(), Failure> {
    let mut all: Vec<(PathBuf, Vec<u8>)> = Vec::new();
    let mut names: HashSet<String> = HashSet::new();
    for ((path, one), figure) in answers.iter().zip(class).zip(figures) {
        let Ok(report) = &one.outcome else { continue };
        let stem =
            path.file_stem().map_or_else(|| "answers".to_owned(), |s| s.to_string_lossy().into_owned());
        let stem = if stem == "-" { "answers".to_owned() } else { stem };
        let mut name = stem.clone();
        let mut number = 2;
        // File systems that know no capitals would take two for one.
        while !names.insert(name.to_lowercase()) {
            name = format!("{stem}-{number}");
            number += 1;
        }
        let (title, figure) = match figure {
            Some((title, figure)) => (title.as_str(), Some(figure)),
            None => (report.language.words().untitled, None),
        };
        all.push((folder.join(format!("{name}.html")), page(title, report, figure)?));
    }
    all.push((folder.join("marks.csv"), grade::class_csv(class).into_bytes()));
    let faults = grade::class_faults(class);
    all.push((folder.join("faults.csv"), grade::faults_csv(&faults).into_bytes()));
    for (path, _) in &all {
        for input in answers {
            files::spare_input("what was handed in", input, [path])?;
        }
    }
    std::fs::create_dir_all(folder).map_err(|error| Failure(format!("{}: {error}", files::shown(folder))))?;
    Ok(files::write_all(&all)?)
}

/// A student's page.
fn page(title: &str, report: &Report, figure: Option<&Figure>) -> Result<Vec<u8>, Failure> {
    let options = render::Options { theme: Theme::Colour, ..render::Options::default() };
    let svg = figure.map(|figure| render::render(figure, Format::Svg, &options)).transpose();
    let svg = svg.map_err(|error| Failure(error.to_string()))?;
    let svg = svg.map(|bytes| String::from_utf8_lossy(&bytes).into_owned());
    let strips: Vec<(f64, f64)> =
        figure.map(sheet::strips).unwrap_or_default().iter().map(|strip| (strip.y0, strip.y1)).collect();
    Ok(report.to_html_cut(title, svg.as_deref(), &strips).into_bytes())
}

/// Takes the drawing that the answers name; what is wrong with its place is told at the key that names it.
fn add_drawing_beside(
    file: &Path,
    named: &str,
    answers: &mut grade::Answers,
    scene: &Scene,
) -> Result<(), Diagnostic> {
    let at = answers.drawing_at;
    let place = files::beside_of(file, named).map_err(|error| {
        let mend = "name a file beside the answers, or give it on the command line: --drawing FILE";
        answers.complain(at, error.to_string(), Some(mend.to_owned()))
    })?;
    let (file, svg) =
        files::read_file(&place).map_err(|error| answers.complain(at, error.to_string(), None))?;
    answers.add_drawing(&svg, &file, scene)
}
