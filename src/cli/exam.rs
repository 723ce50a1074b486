//! `linkgram exam`.

use std::collections::BTreeSet;
use std::fs;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::{Ending, Failure, arguments, failure, print, read_scene};
use crate::check::NotConfirmed;
use crate::exam::{self, Bank, ExamError, Loose, Terms, Variant};
use crate::files;
use crate::parallel;
use crate::render::{self, Format, Lettering, Options};
use crate::scene::{Scene, Subject};
use crate::sheet::{self, Figure, Language};
use crate::solve::Hand;

/// Version of the manifest's form.
const FORM: u64 = 1;
/// The manifest: what exam a folder holds.
const MANIFEST: &str = "exam.json";
/// Folders of one file per variant.
const FOLDERS: [&str; 4] = ["scenes", "questions", "solutions", "answers"];

/// What is to be made, and where.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file, whose `vary` says what may change
    pub(super) scene: PathBuf,
    /// How many variants; as many as there are names where it is left out
    #[arg(long, value_name = "N", required_unless_present = "names")]
    pub(super) variants: Option<usize>,
    /// A list of names, one a line: names.csv says which variant is whose
    #[arg(long, value_name = "FILE")]
    pub(super) names: Option<PathBuf>,
    /// One PDF of all questions, then all solutions, for each language
    #[arg(long)]
    pub(super) booklet: bool,
    /// No answer may be off by a larger part of its value; results that a careful hand may miss by more are
    /// flagged
    #[arg(long, value_name = "PERCENT", default_value = "10%", allow_hyphen_values = true, value_parser = arguments::percent)]
    pub(super) max_tolerance: f64,
    /// What becomes of answers that a careful hand may miss by more: pass-over (such variants), leave-out (what is
    /// so in the scene itself is not asked) or ask (the key says which); where nothing is said pass-over, and ask where that
    /// leaves too few variants
    #[arg(long, value_name = "WHAT")]
    pub(super) loose: Option<String>,
    /// The seed: the same seed gives the same variants
    #[arg(long, value_name = "S", default_value_t = 1)]
    pub(super) seed: u64,
    /// The folder to write into; a run that was interrupted is taken up again
    #[arg(short, long, value_name = "DIR")]
    pub(super) output: PathBuf,
    /// No lines or arcs of a solution cross at a smaller angle
    #[arg(long, value_name = "ANGLE", default_value = "15deg", value_parser = arguments::crossing)]
    pub(super) flattest: f64,
    /// The students' hand, by which tolerances are found: slips in millimetres and degrees
    #[arg(long, value_name = "MM,DEG", default_value = "0.2mm,0.3deg", value_parser = arguments::hand)]
    pub(super) hand: Hand,
    /// Format of the sheets: svg or pdf
    #[arg(long, value_name = "FORMAT")]
    pub(super) format: Option<String>,
    /// Text of SVG sheets and of the banks' figures: outline (paths), embed (with the glyphs that it uses) or live;
    /// where nothing is said, sheets are outlined and figures of banks embed
    #[arg(long, value_name = "KIND")]
    pub(super) text: Option<String>,
    /// Languages: en, ar, ar-x-ajala, fa; several with commas
    #[arg(long, value_name = "LANG")]
    pub(super) lang: Vec<String>,
    /// How many variants are worked on at once; all processors where it is left out. It changes nothing else
    #[arg(long, value_name = "N")]
    pub(super) jobs: Option<usize>,
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let format = format(job)?;
    // Banks are shown by browsers, sheets by whatever there is.
    let options = Options { lettering: lettering(job, Lettering::default())?, ..Options::default() };
    let sheets = Options { lettering: lettering(job, Lettering::portable())?, ..Options::default() };
    let languages = languages(job)?;
    let names = job.names.as_deref().map(names).transpose()?;
    let wanted = job.variants.or(names.as_ref().map(Vec::len)).unwrap_or(0);
    if wanted == 0 {
        return Err(Failure("--variants: one at least".to_owned()));
    }
    if job.max_tolerance <= 0.0 {
        return Err(Failure("--max-tolerance: a tolerance is greater than zero".to_owned()));
    }
    if job.booklet && !cfg!(feature = "pdf") {
        return Err(Failure("--booklet: this build has no PDF: build with the feature `pdf`".to_owned()));
    }
    let (_, scene) = read_scene(&job.scene)?;
    let loose = job.loose.as_deref().map_or(Ok(Loose::default()), |name| {
        let names = Loose::ALL.map(Loose::name).join(", ");
        Loose::from_name(name).ok_or_else(|| Failure(format!("--loose {name}: choose {names}")))
    })?;
    let languages = match (languages.is_empty(), scene.sheet.language.as_deref()) {
        (false, _) => languages,
        (true, stated) => vec![stated.and_then(Language::from_tag).unwrap_or_default()],
    };
    let workers = job.jobs.unwrap_or_else(parallel::processors);
    let terms = Terms {
        variants: wanted,
        seed: job.seed,
        flattest: job.flattest,
        hand: job.hand,
        max_tolerance: job.max_tolerance,
        loose,
    };
    let text = scene.source.text();
    let less = match loose {
        Loose::LeaveOut if !scene.vary.is_empty() => {
            exam::without_loose(&scene, &terms).map_err(|error| refused(&scene, &error))?
        }
        _ => None,
    };
    let left_out = less.as_ref().map_or(String::new(), |(_, names)| {
        format!("not asked, since a careful hand may miss it by more than is allowed: {}\n", names.join(", "))
    });
    let folder =
        Folder { path: &job.output, exam: identity(text.as_bytes(), &terms, format, &sheets, &languages) };
    let known = folder.known_attempts(wanted)?;
    let scene = less.map_or(scene, |(less, _)| less);
    let work = Work {
        scene: &scene,
        terms,
        loose_is_stated: job.loose.is_some(),
        workers,
        format,
        options,
        sheets,
        languages: &languages,
        folder: &folder,
    };
    let (variants, told) = work.variants(known.as_deref())?;
    work.can_be_written(&variants)?;
    let _held = folder.begin(&variants)?;
    let written = work.sheets(&variants)?;
    work.banks(&variants)?;
    work.forms(&variants, names.as_deref())?;
    if job.booklet {
        work.booklets(&variants)?;
    }
    let flagged = flagged(&variants);
    print(&format!(
        "{left_out}{told}{written}{flagged}{}: {} variants\n",
        files::shown(&job.output),
        variants.len()
    ))?;
    Ok(Ending::Fine)
}

/// The names of a list, one a line.
fn names(path: &Path) -> Result<Vec<String>, Failure> {
    let (file, text) = files::read(path)?;
    let names: Vec<String> = text
        .trim_start_matches('\u{feff}')
        .lines()
        .map(|line| line.trim().to_owned())
        .filter(|line| !line.is_empty() && !line.starts_with('#'))
        .collect();
    if names.is_empty() {
        return Err(Failure(format!("{file}: no names; write one on each line")));
    }
    Ok(names)
}

/// What a careful hand may miss by more than is allowed: told to whoever makes the exam.
fn flagged(variants: &[Variant]) -> String {
    let mut told: Vec<(String, Vec<String>, f64)> = Vec::new();
    for variant in variants {
        for answer in &variant.answers {
            let Some(honest) = answer.loose else { continue };
            let name = format!("{} {}", answer.name, answer.part.name());
            let part = if answer.value == 0.0 { f64::INFINITY } else { (honest / answer.value).abs() };
            match told.iter_mut().find(|(known, ..)| *known == name) {
                Some((_, those, most)) => {
                    those.push(variant.name());
                    *most = most.max(part);
                }
                None => told.push((name, vec![variant.name()], part)),
            }
        }
    }
    let line = |(name, those, most): (String, Vec<String>, f64)| {
        // Of a direction the tolerance is an angle, and no part of it.
        let by = if name.ends_with("direction") || !most.is_finite() {
            String::new()
        } else {
            format!(", {:.0} % at worst", 100.0 * most)
        };
        format!(
            "flagged: {name}: a careful hand may be off by more than is allowed in {} of {} variants{by}; ask for \
             something else, draw larger, or allow more (--max-tolerance)\n",
            those.len(),
            variants.len()
        )
    };
    told.into_iter().map(line).collect()
}

/// A field of a table.
fn field(text: &str) -> String {
    let text: String = text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect();
    let text = if text.starts_with(['=', '+', '-', '@']) { format!("'{text}") } else { text };
    if text.contains([',', ';', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

fn format(job: &Job) -> Result<Format, Failure> {
    match job.format.as_deref() {
        None => Ok(Format::Svg),
        Some(name) => match Format::from_name(name) {
            Some(format @ (Format::Svg | Format::Pdf)) => Ok(format),
            _ => Err(Failure(format!("--format {name}: an exam is written as svg or pdf"))),
        },
    }
}

fn lettering(job: &Job, unsaid: Lettering) -> Result<Lettering, Failure> {
    let Some(name) = &job.text else { return Ok(unsaid) };
    Lettering::from_name(name).ok_or_else(|| {
        Failure(format!("--text {name}: choose {}", Lettering::ALL.map(Lettering::name).join(", ")))
    })
}

fn languages(job: &Job) -> Result<Vec<Language>, Failure> {
    let mut languages: Vec<Language> = Vec::new();
    for tag in job.lang.iter().flat_map(|tags| tags.split(',')).map(str::trim) {
        let language = super::language(tag)?;
        if !languages.contains(&language) {
            languages.push(language);
        }
    }
    Ok(languages)
}

/// What must be the same for two runs to make the same exam.
fn identity(text: &[u8], terms: &Terms, format: Format, options: &Options, languages: &[Language]) -> Value {
    let tags: Vec<&str> = languages.iter().map(|l| l.words().tag).collect();
    json!({
        "form": FORM,
        "linkgram": env!("CARGO_PKG_VERSION"),
        "scene": format!("{:016x}", render::svg::fnv(text)),
        "seed": terms.seed,
        "flattest_deg": terms.flattest.to_degrees(),
        "hand": { "length_mm": terms.hand.length, "angle_deg": terms.hand.angle.to_degrees() },
        "max_tolerance": terms.max_tolerance,
        "loose": terms.loose.name(),
        "format": format.name(),
        "text": options.lettering.name(),
        "languages": tags,
    })
}

/// The folder of an exam.
struct Folder<'a> {
    path: &'a Path,
    exam: Value,
}

impl Folder<'_> {
    fn manifest(&self) -> PathBuf {
        self.path.join(MANIFEST)
    }

    /// The tries that an earlier run found, if it found enough; a folder that holds anything else is refused.
    fn known_attempts(&self, wanted: usize) -> Result<Option<Vec<u64>>, Failure> {
        let shown = files::shown(self.path);
        if !self.path.exists() {
            return Ok(None);
        }
        if !self.path.is_dir() {
            return Err(Failure(format!("{shown}: is no folder; an exam is written into one")));
        }
        if !self.manifest().exists() {
            return match files::holds_nothing(self.path)? {
                true => Ok(None),
                false => Err(Failure(format!(
                    "{shown}: holds other files and no {MANIFEST}; choose an empty folder or a new one"
                ))),
            };
        }
        let (_, text) = files::read_file(&self.manifest())?;
        let damaged =
            || Failure(format!("{shown}/{MANIFEST}: not the manifest of an exam; choose another folder"));
        let mut held: Value = serde_json::from_str(&text).map_err(|_| damaged())?;
        let attempts = held.as_object_mut().and_then(|map| map.remove("tries")).ok_or_else(damaged)?;
        let attempts: Vec<u64> = serde_json::from_value(attempts).map_err(|_| damaged())?;
        if let Some(key) = difference(&held, &self.exam) {
            return Err(Failure(format!(
                "{shown}: holds another exam ({key}: {} there, {} here); choose another folder",
                held[key.as_str()],
                self.exam[key.as_str()]
            )));
        }
        if attempts.len() > wanted {
            return Err(Failure(format!(
                "{shown}: holds {} variants of this exam; ask for as many or more, or choose another folder",
                attempts.len()
            )));
        }
        Ok((attempts.len() == wanted).then_some(attempts))
    }

    /// Makes the folders, and says what exam this is before the first file of it is written. Of two runs at once
    /// the second waits for the first, and goes on with what it has left.
    fn begin(&self, variants: &[Variant]) -> Result<files::Held, Failure> {
        let make = |folder: &Path| {
            fs::create_dir_all(folder).map_err(|error| Failure(format!("{}: {error}", files::shown(folder))))
        };
        make(self.path)?;
        let held = files::hold(self.path);
        // Another run may have begun since.
        self.known_attempts(variants.len())?;
        let mut manifest = self.exam.clone();
        manifest["tries"] = variants.iter().map(|v| v.attempt).collect();
        files::write_all(&[(self.manifest(), pretty(&manifest)?)])?;
        for name in FOLDERS {
            let folder = self.path.join(name);
            files::inside(self.path, &folder.join(name))?;
            make(&folder)?;
        }
        Ok(held)
    }
}

/// The first key in which two objects differ.
fn difference(one: &Value, other: &Value) -> Option<String> {
    let keys = |value: &Value| -> Vec<String> {
        value.as_object().map(|map| map.keys().cloned().collect()).unwrap_or_default()
    };
    let all: BTreeSet<String> = keys(one).into_iter().chain(keys(other)).collect();
    all.into_iter().find(|key| one.get(key) != other.get(key))
}

fn pretty(value: &Value) -> Result<Vec<u8>, Failure> {
    let text = serde_json::to_string_pretty(value).map_err(|error| Failure(error.to_string()))?;
    Ok((text + "\n").into_bytes())
}

/// A bar on a terminal, nothing elsewhere.
fn bar(length: usize, template: &str) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length as u64).with_style(style)
}

/// The work of one run.
struct Work<'a> {
    scene: &'a Scene,
    terms: Terms,
    /// Whether it was said what becomes of answers that a careful hand may miss.
    loose_is_stated: bool,
    workers: usize,
    format: Format,
    options: Options,
    /// The same of what is printed.
    sheets: Options,
    languages: &'a [Language],
    folder: &'a Folder<'a>,
}

impl Work<'_> {
    /// The variants, and what is told of the search.
    fn variants(&self, known: Option<&[u64]>) -> Result<(Vec<Variant>, String), Failure> {
        let bar = bar(self.terms.variants, "{bar:40} {pos}/{len} variants drawn, {eta} left");
        let refused = |error: &ExamError| refused(self.scene, error);
        let all_the_same = Terms { loose: Loose::Ask, ..self.terms };
        let variants = if let Some(attempts) = known {
            // What the first run took it took knowingly.
            let again = exam::redraw(self.scene, &all_the_same, attempts, self.workers, &|| bar.inc(1));
            again.map_err(|error| refused(&error))?.map(|variants| (variants, String::new())).ok_or_else(
                || {
                    let path = self.folder.manifest();
                    Failure(format!(
                        "{}: its tries give no variants; choose another folder",
                        files::shown(&path)
                    ))
                },
            )
        } else {
            let set = |found: usize| bar.set_position(found as u64);
            let draw = |terms: &Terms| exam::draw(self.scene, terms, self.workers, &set);
            let (drawn, asked) = match draw(&self.terms) {
                Err(ExamError::Exhausted { tally, .. }) if !self.loose_is_stated && tally.has_loose() => {
                    let why = "too few variants have only answers that a careful hand can measure; asked all the same:\n";
                    (draw(&all_the_same), why)
                }
                drawn => (drawn, ""),
            };
            let drawn = drawn.map_err(|error| refused(&error))?;
            let passed = if drawn.tally.flaws.is_empty() {
                String::new()
            } else {
                format!("{} tries: {}\n", drawn.tries, drawn.tally)
            };
            Ok((drawn.variants, format!("{passed}{asked}")))
        };
        bar.finish_and_clear();
        variants
    }

    /// Refuses what this build cannot write, before there is a folder.
    fn can_be_written(&self, variants: &[Variant]) -> Result<(), Failure> {
        for (variant, language) in variants.iter().zip(self.languages) {
            let figure = exam::question(&variant.scene, *language)
                .map_err(|error| not_drawn(&variant.scene, &error))?;
            for (format, options) in [(self.format, &self.sheets), (Format::Svg, &self.options)] {
                render::render(&figure, format, options)
                    .map_err(|error| super::not_written(&variant.scene, &error))?;
            }
        }
        Ok(())
    }

    fn path(&self, folder: &str, variant: &Variant, language: Language) -> PathBuf {
        let name = format!("{}.{}.{}", variant.name(), language.words().tag, self.format.name());
        self.folder.path.join(folder).join(name)
    }

    /// Writes what is missing of each variant: all its files at once, or none.
    fn sheets(&self, variants: &[Variant]) -> Result<String, Failure> {
        let missing: Vec<&Variant> = variants.iter().filter(|v| !self.is_there(v)).collect();
        let told = match variants.len() - missing.len() {
            0 => String::new(),
            there => format!("{there} variants are there already\n"),
        };
        let bar = bar(missing.len(), "{bar:40} {pos}/{len} sheets, {eta} left");
        let written = parallel::map_with(self.workers, &missing, |variant| {
            let result = self.write(variant);
            bar.inc(1);
            result
        });
        bar.finish_and_clear();
        written.into_iter().collect::<Result<(), Failure>>()?;
        Ok(told)
    }

    fn scene_path(&self, variant: &Variant) -> PathBuf {
        self.folder.path.join("scenes").join(format!("{}.json", variant.name()))
    }

    fn is_there(&self, variant: &Variant) -> bool {
        let sheet = |folder| self.languages.iter().all(|l| self.path(folder, variant, *l).exists());
        self.scene_path(variant).exists() && sheet("questions") && sheet("solutions")
    }

    fn write(&self, variant: &Variant) -> Result<(), Failure> {
        let scene = &variant.scene;
        let mut all = vec![(self.scene_path(variant), variant.text.clone().into_bytes())];
        for &language in self.languages {
            let question = exam::question(scene, language).map_err(|error| not_drawn(scene, &error))?;
            let solution = exam::solution(scene, language).map_err(|error| not_drawn(scene, &error))?;
            for (folder, figure) in [("questions", question), ("solutions", solution)] {
                let bytes = render::render(&figure, self.format, &self.sheets);
                let bytes = bytes.map_err(|error| Failure(error.to_string()))?;
                all.push((self.path(folder, variant, language), bytes));
            }
        }
        Ok(files::write_all(&all)?)
    }

    /// Writes the key and the banks: all of them, or none.
    fn banks(&self, variants: &[Variant]) -> Result<(), Failure> {
        let root = self.folder.path;
        let key = exam::json(self.scene, &self.terms, variants);
        let mut all = vec![
            (root.join("key.csv"), exam::csv(variants).into_bytes()),
            (root.join("key.json"), pretty(&key)?),
        ];
        for &language in self.languages {
            let figures = parallel::map_with(self.workers, variants, |variant| {
                let not_drawn = |error: NotConfirmed| not_drawn(&variant.scene, &error);
                let card = exam::card(&variant.scene, language).map_err(not_drawn)?;
                Ok::<_, Failure>([card, exam::solution(&variant.scene, language).map_err(not_drawn)?])
            });
            let figures: Vec<_> = figures.into_iter().collect::<Result<_, _>>()?;
            let bank = Bank::new(self.scene, language, variants.iter().zip(figures).collect(), &self.options)
                .map_err(|error| Failure(error.to_string()))?;
            let tag = language.words().tag;
            for (number, text) in (1..).zip(exam::numerical(&bank)) {
                let name = format!("moodle-numerical.{tag}.{number:02}.xml");
                all.push((root.join(name), text.into_bytes()));
            }
            all.push((root.join(format!("moodle-cloze.{tag}.xml")), exam::cloze(&bank).into_bytes()));
            let package = exam::package(&bank).map_err(|error| Failure(error.to_string()))?;
            all.push((root.join(format!("qti.{tag}.zip")), package));
        }
        Ok(files::write_all(&all)?)
    }
}

impl Work<'_> {
    /// Writes the sheet with boxes to write in, for each variant the table into which it is typed and which `grade` reads,
    /// and whose variant is which.
    fn forms(&self, variants: &[Variant], names: Option<&[String]>) -> Result<(), Failure> {
        let root = self.folder.path;
        let mut all = Vec::new();
        for variant in variants {
            let name = format!("{}.csv", variant.name());
            all.push((root.join("answers").join(name), exam::answers_csv(variant).into_bytes()));
        }
        if let Some(first) = variants.first() {
            for &language in self.languages {
                let figure = exam::form(self.scene, first, language);
                let bytes = render::render(&figure, self.format, &self.sheets)
                    .map_err(|error| Failure(error.to_string()))?;
                let name = format!("answer-sheet.{}.{}", language.words().tag, self.format.name());
                all.push((root.join(name), bytes));
            }
        }
        if let Some(names) = names {
            let mut text = String::from("name,variant\n");
            for (name, variant) in names.iter().zip(variants.iter().cycle()) {
                text.push_str(&format!("{},{}\n", field(name), variant.name()));
            }
            all.push((root.join("names.csv"), text.into_bytes()));
        }
        Ok(files::write_all(&all)?)
    }

    /// Writes all questions and then all solutions as one document.
    fn booklets(&self, variants: &[Variant]) -> Result<(), Failure> {
        let mut all = Vec::new();
        for &language in self.languages {
            let drawn = |draw: fn(&Scene, Language) -> Result<Figure, NotConfirmed>| {
                let figures = parallel::map_with(self.workers, variants, |variant| {
                    draw(&variant.scene, language).map_err(|error| not_drawn(&variant.scene, &error))
                });
                figures.into_iter().collect::<Result<Vec<Figure>, Failure>>()
            };
            let mut figures = drawn(exam::question)?;
            figures.extend(drawn(exam::solution)?);
            let Some(figure) = sheet::booklet(&figures) else { continue };
            let bytes = render::render(&figure, Format::Pdf, &self.options)
                .map_err(|error| Failure(error.to_string()))?;
            let name = format!("booklet.{}.pdf", language.words().tag);
            all.push((self.folder.path.join(name), bytes));
        }
        Ok(files::write_all(&all)?)
    }
}

/// Why a sheet of a variant is not drawn.
fn not_drawn(scene: &Scene, error: &NotConfirmed) -> Failure {
    match error {
        NotConfirmed::Unsolved(error) => failure(scene, error),
        NotConfirmed::Unconfirmed(why) => Failure::unconfirmed(format!(
            "{}: not confirmed, nothing more is written: {why}",
            scene.source.file()
        )),
    }
}

/// Why there is no exam, at the place in the scene that it is about.
fn refused(scene: &Scene, error: &ExamError) -> Failure {
    let at_vary = |mend: &str| -> Failure {
        scene.source.complain(Subject::Vary, error.to_string(), Some(mend.to_owned())).into()
    };
    match error {
        ExamError::Scene(error) => failure(scene, error),
        ExamError::Unconfirmed(why) => {
            Failure::unconfirmed(format!("{}: not confirmed, no exam is written: {why}", scene.source.file()))
        }
        ExamError::NothingVaries => at_vary(
            "say what variants may change, such as \"vary\": {\"links.2.length\": {\"from\": 12, \"to\": 18, \"step\": 0.5}}",
        ),
        ExamError::NothingLeft => {
            at_vary("ask for something else, draw larger, or allow more: --max-tolerance")
        }
        ExamError::Less(diagnostic) => (**diagnostic).clone().into(),
        ExamError::TooFew { .. } => at_vary("widen the ranges, take finer steps, or vary more numbers"),
        ExamError::Exhausted { tally, .. } if tally.has_loose() => at_vary(
            "do not ask it: --loose leave-out; ask it all the same: --loose ask; or draw larger, or allow more: \
             --max-tolerance",
        ),
        ExamError::Exhausted { .. } => at_vary("change the ranges that cause what most tries failed on"),
    }
}
