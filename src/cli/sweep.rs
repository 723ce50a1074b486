//! `linkgram sweep`.

use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::arguments::{self, Against};
use super::{Ending, Failure, print, read_scene};
use crate::check::{SweepUnconfirmed, Unconfirmed, confirm, confirm_sweep};
use crate::drawing::Wish;
use crate::files;
use crate::graphical::cycle::CycleSheet;
use crate::live::{Live, LiveError};
use crate::mechanism::friction::Friction;
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::plan::Extent;
use crate::render::{self, Format};
use crate::report::{diagnose, short};
use crate::scene::{Scene, Subject};
use crate::sheet::{Figure, Language};
use crate::solve::{SolveError, Solved, governed, solve};
use crate::sweep::{
    Event, EventKind, InputKind, Over, Reversal, SliderStroke, Stretch, Sweep, SweepError, SweepWithBounds,
    Without,
};

/// More positions than this show a progress bar.
const MANY: usize = 100_000;
/// So many are computed between two movements of the bar.
const PORTION: usize = 50_000;

/// Whether pairs rub.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum Rubbing {
    /// As the scene says.
    On,
    /// Nothing rubs.
    Off,
}

/// What to sweep and where to write it.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file; - for standard input
    pub(super) scene: PathBuf,
    /// Equal steps over the range; one position more than steps
    #[arg(long, value_name = "N", conflicts_with = "tolerance", value_parser = clap::value_parser!(u32).range(1..=i64::from(crate::limits::STEPS)))]
    pub(super) steps: Option<u32>,
    /// As many positions as it takes for no column to stray from the line between two of them by more
    /// than this part of its range, except where a column grows without end
    #[arg(long, value_name = "PERCENT", allow_hyphen_values = true, value_parser = arguments::straying)]
    pub(super) tolerance: Option<f64>,
    /// Where to begin, in the scene's unit of the input or of time; a whole turn where nothing is said
    #[arg(long, value_name = "PLACE", allow_negative_numbers = true, value_parser = arguments::place, requires = "to")]
    pub(super) from: Option<f64>,
    /// Where to end
    #[arg(long, value_name = "PLACE", allow_negative_numbers = true, value_parser = arguments::place, requires = "from")]
    pub(super) to: Option<f64>,
    /// What to go over: the first input with the rates as they are, or time, in which every input moves from
    /// the scene's instant on with constant acceleration
    #[arg(long, value_enum, default_value_t = Against::Input)]
    pub(super) against: Against,
    /// A bound for every number of the tables
    #[arg(long)]
    pub(super) bounds: bool,
    /// Writes what the independent solver does not confirm, with a note that says so
    #[arg(long)]
    pub(super) unchecked: bool,
    /// Whether pairs rub, in a scene that says how
    #[arg(long, value_enum, default_value_t = Rubbing::On)]
    pub(super) friction: Rubbing,
    /// Only these of the asked quantities, such as v(B),a(D)
    #[arg(long, value_name = "NAMES")]
    pub(super) only: Option<String>,
    /// Language of the diagrams: en, ar, ar-x-ajala, fa
    #[arg(long, value_name = "LANG")]
    pub(super) lang: Option<String>,
    /// Where to write; the ending chooses what: .csv and .json are tables, .svg, .png, .pdf and .tex diagrams.
    /// What happens on the way, on stdout, without it
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
}

/// Steps where neither they nor a tolerance are stated.
const STEPS: u32 = 36;

/// What is written into a file.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Output {
    Csv,
    Json,
    Live,
    Diagrams(Format),
}

impl Output {
    fn of(path: &Path) -> Result<Self, Failure> {
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or_default();
        match Format::from_name(ending) {
            _ if name.to_ascii_lowercase().ends_with(".live.json") => Ok(Self::Live),
            _ if ending.eq_ignore_ascii_case("csv") => Ok(Self::Csv),
            Some(Format::Json) => Ok(Self::Json),
            Some(format) => Ok(Self::Diagrams(format)),
            None => Err(Failure(format!(
                "{}: end the name in .csv or .json for a table, in .live.json for the drawing as a page runs it, in .svg, .png, .pdf or .tex for diagrams",
                files::shown(path)
            ))),
        }
    }
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let outputs: Vec<Output> = job.output.iter().map(|path| Output::of(path)).collect::<Result<_, _>>()?;
    if job.bounds && !outputs.is_empty() && outputs.iter().all(|o| matches!(o, Output::Diagrams(_))) {
        return Err(Failure("--bounds is for tables: write one with -o FILE.csv or -o FILE.json".to_owned()));
    }
    files::spare(&job.scene, &job.output)?;
    let (file, mut scene) = read_scene(&job.scene)?;
    if let Some(names) = &job.only {
        choose(&mut scene, names)?;
    }
    if job.friction == Rubbing::Off {
        scene.mechanism.forces.friction = Friction::default();
    }
    let scene = &scene;
    let language = match &job.lang {
        Some(tag) => super::language(tag)?,
        None => crate::drawing::language(scene),
    };
    let unit = unit_of(scene, job.against.over());
    let stated = match (job.from, job.to) {
        (None, None) => None,
        (Some(from), Some(to)) => Some([from * unit.si, to * unit.si]),
        _ => return Err(Failure("give both --from and --to, in the scene's units".to_owned())),
    };
    let turned = scene.mechanism.forces.cycle.is_some().then(|| turned(scene)).transpose()?;
    let cycle = turned.as_ref().and_then(|solved| solved.solution.construction.cycle.as_ref());
    if let (true, Some(sheet)) = (scene.mechanism.inputs.is_empty(), cycle) {
        return of_cycle_alone(job, scene, &outputs, sheet, language);
    }
    let mut sweep =
        Sweep::over(job.against.over(), &scene.mechanism, stated).map_err(|error| refusal(scene, error))?;
    let only_diagrams = !outputs.is_empty() && outputs.iter().all(|o| matches!(o, Output::Diagrams(_)));
    if only_diagrams && job.only.is_none() && !asks(scene) {
        // Nobody asked for anything: how the sliders and rockers move, not forty diagrams.
        let mut outputs_only = scene.mechanism.clone();
        outputs_only.asked = sweep.of_outputs().into_iter().filter_map(|of| named(scene, of)).collect();
        if !outputs_only.asked.is_empty() && outputs_only.asked.len() < scene.mechanism.asked.len() {
            let names: Vec<&str> = outputs_only.asked.iter().map(|asked| asked.name.as_str()).collect();
            let names = names.join(", ");
            let help = "`find` or --only chooses others";
            let _ = writeln!(io::stderr(), "{file}: the scene asks for nothing; drawn are {names}; {help}");
            sweep = Sweep::over(job.against.over(), &outputs_only, stated)
                .map_err(|error| refusal(scene, error))?;
        }
    }
    let sweep = sweep;
    let mut report = Report { file: &file, scene, sweep: &sweep, unit: &unit, unconfirmed: None, cycle };
    if let Err(why) = confirm_sweep(&sweep) {
        let why = report.unconfirmed(&why);
        if !job.unchecked {
            let help = "`--unchecked` writes it with a note that says so";
            let _ = writeln!(io::stderr(), "{file}: not confirmed, nothing is written: {why}; help: {help}");
            return Ok(Ending::DoesNotHold);
        }
        let _ = writeln!(io::stderr(), "{file}: not confirmed: {why}");
        report.unconfirmed = Some(why);
    }
    let report = report;
    let places = || match (job.steps, job.tolerance) {
        (_, Some(tolerance)) => sweep.adapted(tolerance),
        (steps, None) => sweep.equal_steps(steps.unwrap_or(STEPS)),
    };
    let bounded =
        job.bounds.then(|| sweep.with_bounds()).transpose().map_err(|error| refusal(scene, error))?;
    let bounded = bounded.as_ref();
    let said = |error: std::io::Error| Failure(format!("standard output: {error}"));
    if job.output.is_empty() {
        print(&report.text())?;
        // Whoever says how many positions wants to see them.
        if job.steps.is_some() || job.tolerance.is_some() || job.bounds {
            print("\n")?;
            let mut table = Vec::new();
            report.csv(&mut table, &places(), bounded).map_err(said)?;
            super::print_bytes(&table)?;
        }
        return Ok(Ending::Fine);
    }
    let options = render::Options { theme: crate::drawing::theme(scene), ..Default::default() };
    let diagrams = outputs.iter().any(|output| matches!(output, Output::Diagrams(_)));
    let figure = diagrams.then(|| {
        let own =
            crate::sheet::diagrams::of_sweep_with(scene, &sweep, language, report.unconfirmed.as_deref());
        let drawn = cycle.map_or_else(|| Ok(Vec::new()), |_| of_cycle(scene, language));
        drawn.map(
            |drawn| if drawn.is_empty() { own } else { crate::sheet::stack(&[vec![own], drawn].concat()) },
        )
    });
    let figure = figure.transpose()?;
    let live = outputs.contains(&Output::Live).then(|| live(job, scene, stated, language)).transpose()?;
    let drawn: Vec<Option<Vec<u8>>> = outputs
        .iter()
        .map(|output| match (output, &figure) {
            (Output::Live, _) => Ok(live.clone()),
            (Output::Diagrams(format), Some(figure)) => render::render(figure, *format, &options).map(Some),
            _ => Ok(None),
        })
        .collect::<Result<_, _>>()
        .map_err(|error| super::not_written(scene, &error))?;
    let places = if drawn.iter().all(Option::is_some) { Vec::new() } else { places() };
    files::stream_all(job.output.iter().map(PathBuf::as_path), |index, to| {
        match (drawn.get(index), outputs.get(index)) {
            (Some(Some(bytes)), _) => to.write_all(bytes),
            (_, Some(Output::Json)) => report.json(to, &places, bounded),
            _ => report.csv(to, &places, bounded),
        }
    })?;
    Ok(Ending::Fine)
}

/// The solution of a scene with a turning-moment diagram, which the independent solver confirms.
fn turned(scene: &Scene) -> Result<Solved, Failure> {
    let solved = solve(scene, Extent::Asked, crate::sheet::scale::for_scene)
        .map_err(|error| super::failure(scene, &error))?;
    let unconfirmed = |why: Unconfirmed| Failure(crate::drawing::unconfirmed(scene, &why));
    confirm(scene, &solved).map_err(unconfirmed)?;
    Ok(solved)
}

/// The figures of a turning-moment diagram.
fn of_cycle(scene: &Scene, language: Language) -> Result<Vec<Figure>, Failure> {
    let draw = |names: &[&str]| {
        let figures = names.iter().map(|name| (*name).to_owned()).collect();
        let wish = Wish { figures, language: Some(language), ..Wish::default() };
        crate::drawing::figure(scene, &wish).map_err(|error| Failure(error.told(scene)))
    };
    // Of areas alone there is no curve.
    let both = draw(&["turning-moment", "energy"]).or_else(|_| draw(&["energy"]))?;
    Ok(vec![both])
}

/// A turning-moment diagram without a mechanism: its table of levels, and its figures.
fn of_cycle_alone(
    job: &Job,
    scene: &Scene,
    outputs: &[Output],
    sheet: &CycleSheet,
    language: Language,
) -> Result<Ending, Failure> {
    if outputs.is_empty() {
        print(&levels_told(scene, sheet))?;
        return Ok(Ending::Fine);
    }
    let options = render::Options { theme: crate::drawing::theme(scene), ..Default::default() };
    let written: Vec<Vec<u8>> = outputs
        .iter()
        .map(|output| match output {
            Output::Csv => Ok(levels_csv(scene, sheet).into_bytes()),
            Output::Json => {
                let told = json!({
                    "scene": scene.title.in_language("en").unwrap_or(scene.source.file()),
                    "cycle": levels_json(scene, sheet),
                });
                let text = serde_json::to_string_pretty(&told).map_err(|error| Failure(error.to_string()))?;
                Ok((text + "\n").into_bytes())
            }
            Output::Live => Err(Failure("a turning-moment diagram alone does not move".to_owned())),
            Output::Diagrams(format) => {
                let figure = crate::sheet::stack(&of_cycle(scene, language)?);
                render::render(&figure, *format, &options).map_err(|error| super::not_written(scene, &error))
            }
        })
        .collect::<Result<_, _>>()?;
    files::stream_all(job.output.iter().map(PathBuf::as_path), |index, to| {
        written.get(index).map_or(Ok(()), |bytes| to.write_all(bytes))
    })?;
    Ok(Ending::Fine)
}

/// The crossings of a turning-moment diagram, or its areas, with their levels: number, angle, torque, level, and the area
/// to the next, in the scene's units.
fn levels(scene: &Scene, sheet: &CycleSheet) -> Vec<(usize, [Option<f64>; 4])> {
    let (angle, torque) = (scene.units.angle.si, scene.units.torque.si);
    let rows = sheet.levels.len().max(sheet.crossings.len());
    let row = |index: usize| {
        let crossing = sheet.crossings.get(index);
        let numbers = [
            crossing.map(|crossing| crossing.at / angle),
            crossing.map(|crossing| crossing.torque / torque),
            sheet.levels.get(index).map(|level| level / torque),
            sheet.areas.get(index).map(|area| area / torque),
        ];
        (index + 1, numbers)
    };
    (0..rows).map(row).collect()
}

/// Their headings.
fn levels_head(scene: &Scene) -> [String; 5] {
    let (angle, torque) = (&scene.units.angle.symbol, &scene.units.torque.symbol);
    [
        "crossing".to_owned(),
        format!("angle [{angle}]"),
        format!("torque [{torque}]"),
        format!("level [{torque}]"),
        format!("area [{torque}]"),
    ]
}

fn levels_csv(scene: &Scene, sheet: &CycleSheet) -> String {
    let mut out = levels_head(scene).map(|head| quoted(&head)).join(",") + "\n";
    for (number, numbers) in levels(scene, sheet) {
        let _ = write!(out, "{number}");
        for number in numbers {
            let _ = match number {
                Some(number) => write!(out, ",{}", Plain(number)),
                None => write!(out, ","),
            };
        }
        out.push('\n');
    }
    out
}

fn levels_told(scene: &Scene, sheet: &CycleSheet) -> String {
    let told = |number: Option<f64>| number.map_or_else(String::new, short);
    let mut rows: Vec<[String; 5]> = vec![levels_head(scene)];
    rows.extend(levels(scene, sheet).into_iter().map(|(number, [angle, torque, level, area])| {
        [number.to_string(), told(angle), told(torque), told(level), told(area)]
    }));
    let widths: [usize; 5] =
        std::array::from_fn(|at| rows.iter().map(|row| row[at].chars().count()).max().unwrap_or(0));
    let mut out = String::new();
    for row in rows {
        let cells: Vec<String> =
            row.iter().zip(widths).map(|(cell, width)| format!("{cell:>width$}")).collect();
        let _ = writeln!(out, "{}", cells.join("  "));
    }
    out
}

fn levels_json(scene: &Scene, sheet: &CycleSheet) -> Value {
    let rows = levels(scene, sheet).into_iter().map(|(number, [angle, torque, level, area])| {
        json!({ "crossing": number, "angle": angle, "torque": torque, "level": level, "area": area })
    });
    json!({
        "units": { "angle": scene.units.angle.symbol, "torque": scene.units.torque.symbol },
        "period": sheet.period / scene.units.angle.si,
        "levels": rows.collect::<Vec<_>>(),
    })
}

/// The drawing as a page runs it.
fn live(job: &Job, scene: &Scene, stated: Option<[f64; 2]>, language: Language) -> Result<Vec<u8>, Failure> {
    let live = Live::of(scene, job.against.over(), stated).map_err(|error| match error {
        LiveError::Unsolved(error) => super::failure(scene, &error),
        LiveError::Sweep(error) => refusal(scene, error),
        LiveError::Number(what) => scene.source.complain(Subject::Inputs, what.to_owned(), None).into(),
    })?;
    let mut bytes = serde_json::to_vec(&live.json(language)).map_err(|error| Failure(error.to_string()))?;
    bytes.push(b'\n');
    Ok(bytes)
}

/// Whether the scene itself says what it asks for.
fn asks(scene: &Scene) -> bool {
    serde_json::from_str::<Value>(scene.source.text()).is_ok_and(|root| root.get("find").is_some())
}

/// A quantity as the scene asks for it; places and angles, for which nobody asks who asks for nothing, in the scene's units.
fn named(scene: &Scene, quantity: Quantity) -> Option<Asked> {
    let unit = match quantity {
        Quantity::Position(_) => scene.units.length.clone(),
        Quantity::Angle(_) => scene.units.angle.clone(),
        _ => return scene.mechanism.asked.iter().find(|asked| asked.quantity == quantity).cloned(),
    };
    let name = quantity.name(&scene.mechanism);
    Some(Asked { name, quantity, unit, method: Method::default() })
}

/// Keeps these of the asked quantities, in this order.
fn choose(scene: &mut Scene, names: &str) -> Result<(), Failure> {
    let mut chosen = Vec::new();
    for name in listed(names) {
        match scene.mechanism.asked.iter().find(|asked| asked.name == name) {
            Some(asked) => chosen.push(asked.clone()),
            None => {
                let asked: Vec<&str> = scene.mechanism.asked.iter().map(|a| a.name.as_str()).collect();
                let asked = asked.join(", ");
                let what = format!("--only: `{name}` is not asked for; the scene asks for {asked}");
                return Err(Failure(what + "; help: add it to `find`"));
            }
        }
    }
    if chosen.is_empty() {
        let what = "--only names no quantity; help: name some of `find`, as in --only \"v(B),omega(3)\"";
        return Err(Failure(what.to_owned()));
    }
    scene.mechanism.asked = chosen;
    Ok(())
}

/// Names between commas; those within parentheses belong to a name.
fn listed(names: &str) -> Vec<String> {
    let (mut all, mut depth) = (vec![String::new()], 0_usize);
    for c in names.chars() {
        match c {
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ => {}
        }
        match (c, all.last_mut()) {
            (',', _) if depth == 0 => all.push(String::new()),
            (_, Some(name)) if !c.is_whitespace() => name.push(c),
            _ => {}
        }
    }
    all.retain(|name| !name.is_empty());
    all
}

/// The unit of what is varied.
pub(super) fn unit_of(scene: &Scene, over: Over) -> Unit {
    match scene.mechanism.inputs.first() {
        _ if over == Over::Time => scene.units.time.clone(),
        Some(crate::mechanism::Input::Slide { .. }) => scene.units.length.clone(),
        _ => scene.units.angle.clone(),
    }
}

/// Which number of a sweep the independent solver does not confirm.
pub(super) fn not_confirmed(scene: &Scene, sweep: &Sweep, unit: &Unit, why: &SweepUnconfirmed) -> String {
    let report = Report { file: scene.source.file(), scene, sweep, unit, unconfirmed: None, cycle: None };
    format!("not confirmed: {}", report.unconfirmed(why))
}

fn refusal(scene: &Scene, error: SweepError) -> Failure {
    match error {
        SweepError::Structure(error) => diagnose(scene, &SolveError::Structure(error)).into(),
        SweepError::Draw(crate::graphical::DrawError::NoConstruction { .. }) => scene
            .source
            .complain(
                Subject::Inputs,
                "no construction is known for a group of links, neither by dyads nor by trial".to_owned(),
                Some("drive another link, so that the mechanism falls apart into dyads".to_owned()),
            )
            .into(),
        SweepError::Draw(error) => diagnose(scene, &SolveError::Draw(error)).into(),
        error => scene.source.complain(Subject::Inputs, error.to_string(), None).into(),
    }
}

/// A number that reads back to the same double: plainly where that is short, else with a power of ten.
struct Plain(f64);

impl std::fmt::Display for Plain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let size = self.0.abs();
        if size == 0.0 || (1e-5..1e16).contains(&size) {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// A heading for a table: in quotation marks where it holds a comma.
fn quoted(text: &str) -> String {
    if text.contains([',', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text.to_owned() }
}

/// Why a quantity has no column.
fn reason(why: Without) -> &'static str {
    match why {
        Without::AtInfinity => "at infinity in every position",
        Without::Undefined(why) => why,
    }
}

/// A number of a row.
#[derive(Debug, Clone, Copy)]
enum Cell {
    /// A column of the sweep.
    Column(usize),
    /// The size of a force, by the first of its columns.
    Size(usize),
    /// Its direction.
    Direction(usize),
}

struct Report<'s> {
    file: &'s str,
    scene: &'s Scene,
    sweep: &'s Sweep,
    unit: &'s Unit,
    /// What the independent solver does not confirm.
    unconfirmed: Option<String>,
    /// The turning-moment diagram.
    cycle: Option<&'s CycleSheet>,
}

impl Report<'_> {
    fn place(&self, at: f64) -> String {
        // What is left of zero after roots are found is rounding of the range.
        let size = self.sweep.range[0].abs().max(self.sweep.range[1].abs());
        let at = if at.abs() < 64.0 * f64::EPSILON * size { 0.0 } else { at };
        format!("{} {}", short(at / self.unit.si), self.unit.symbol)
    }

    /// Which number is not confirmed, where, and by how much.
    fn unconfirmed(&self, why: &SweepUnconfirmed) -> String {
        match why {
            SweepUnconfirmed::Refused { at, why } => {
                format!("at {} the independent solver refuses: {why}", self.place(*at))
            }
            SweepUnconfirmed::Stuck { at, why, .. } => format!("at {} {why}", self.place(*at)),
            SweepUnconfirmed::Carried(astray) => {
                let unit = if astray.name.starts_with("angle") {
                    &self.scene.units.angle
                } else {
                    &self.scene.units.length
                };
                let told = |value: f64| format!("{} {}", short(value / unit.si), unit.symbol);
                let (at, name) = (self.place(astray.at), &astray.name);
                if astray.leaps {
                    return format!("at {at} {name} leaps by {}", told(astray.swept));
                }
                let told = |value: f64| told(value * self.unit.si);
                format!(
                    "at {at} {name} changes by {} for each {} by the drawing and by {} by the independent solver",
                    told(astray.swept),
                    self.unit.symbol,
                    told(astray.analytic)
                )
            }
            SweepUnconfirmed::Number(number) => {
                let unit = self.unit_of(number.column);
                let told = |value: f64| format!("{} {}", short(value / unit.si), unit.symbol);
                format!(
                    "at {} {} is {} by the drawing and {} by the independent solver: {} apart, where the bounds \
                     allow {}",
                    self.place(number.at),
                    self.sweep.columns[number.column].name(),
                    told(number.swept),
                    told(number.analytic),
                    told((number.swept - number.analytic).abs()),
                    told(number.allowed)
                )
            }
        }
    }

    /// Name and value of a column, in its unit.
    fn column(&self, index: usize, value: f64) -> String {
        let unit = self.unit_of(index);
        let name = self.sweep.name_of_extreme(index);
        format!("{name} = {} {}", short(value / unit.si), unit.symbol)
    }

    /// What the sweep added itself is told in the scene's unit.
    fn unit_of(&self, index: usize) -> &Unit {
        let column = &self.sweep.columns[index];
        match column.asked.quantity {
            Quantity::Position(_) if column.watched => &self.scene.units.length,
            _ => &column.asked.unit,
        }
    }

    fn input(&self) -> String {
        self.sweep.input.told(&self.scene.mechanism)
    }

    fn event(&self, event: &Event) -> String {
        let links: Vec<String> = self.sweep.links(event).iter().map(u32::to_string).collect();
        let blame = match links.len() {
            0 => String::new(),
            1 => format!(" at link {}", links[0]),
            _ => format!(": links {} in line", links.join(" and ")),
        };
        let what = match event.kind {
            EventKind::Limit => format!("limit of the input{blame}"),
            EventKind::ChangePoint => format!("change point{blame}"),
            EventKind::DeadPosition => format!("dead position{blame}"),
            EventKind::AtInfinity { centre, direction } => {
                let name = &self.sweep.centres[centre].asked.name;
                format!("{name} at infinity, in the direction of {} deg", short(direction.to_degrees()))
            }
            EventKind::Least { column, value } => format!("least {}", self.column(column, value)),
            EventKind::Greatest { column, value } => format!("greatest {}", self.column(column, value)),
        };
        format!("{}: {what}", self.place(event.at))
    }

    fn stroke(&self, stroke: &SliderStroke) -> String {
        let unit = self.unit_of(stroke.column);
        let column = self.sweep.columns[stroke.column].name();
        format!(
            "{column}: stroke {} {} between {} and {}, time ratio {}",
            short(stroke.length / unit.si),
            unit.symbol,
            self.place(stroke.ends[0]),
            self.place(stroke.ends[1]),
            short(stroke.time_ratio)
        )
    }

    /// What turns round at a place, and what leaps there.
    fn reversal(&self, reversal: &Reversal) -> String {
        let leaps = self.cells().into_iter().filter_map(|cell| {
            let leaps = match cell {
                Cell::Column(c) => self.sweep.columns[c].axis.is_none() && reversal.leaps(c, false),
                Cell::Size(c) => reversal.leaps(c, true),
                Cell::Direction(_) => false,
            };
            if !leaps {
                return None;
            }
            let [before, after] = [0, 1].map(|side| self.told(cell, &reversal.sides[side]));
            let (name, unit) = self.head_of(cell);
            let (before, after) = before.zip(after)?;
            let name = name.strip_suffix(".size").map_or(name.clone(), |name| format!("|{name}|"));
            Some(format!("{name} = {} {unit} before, {} {unit} after", short(before), short(after)))
        });
        let mut told = format!("{}: turns round: {}", self.place(reversal.at), reversal.what.join(", "));
        for leap in leaps {
            let _ = write!(told, "; {leap}");
        }
        told
    }

    /// Where a governor is stable.
    fn governor(&self) -> String {
        let mut out = String::new();
        let unit = &self.scene.units.length;
        let range = (self.sweep.input != InputKind::Time).then_some(self.sweep.range);
        if let Ok(Some(governed)) = governed(&self.scene.mechanism, range) {
            for part in governed.parts.iter().chain(&governed.elsewhere) {
                let [from, to] = part.radii.map(|radius| short(radius / unit.si));
                let name = part.stability.name();
                let _ = write!(out, "{name} from r = {from} to {to} {}", unit.symbol);
                // The same radius may stand in several.
                if governed.elsewhere.is_empty() || range.is_none() {
                    out.push('\n');
                } else {
                    let [from, to] = part.at.map(|at| self.place(at));
                    let _ = writeln!(out, " ({from} to {to})");
                }
            }
        }
        out
    }

    /// From where to where the mechanism moves, and whether it has to be taken apart for that. Stretches between which
    /// no meet changes its side are told as one.
    fn moves(&self) -> Vec<(f64, f64, bool)> {
        let mut moves: Vec<(f64, f64, bool)> = Vec::new();
        let mut last: Option<&Stretch> = None;
        for stretch in &self.sweep.stretches {
            let goes_on = last.is_some_and(|l| {
                l.to == stretch.from && l.apart == stretch.apart && self.sweep.is_one_assembly(l, stretch)
            });
            match moves.last_mut() {
                Some(one) if goes_on => one.1 = stretch.to,
                _ => moves.push((stretch.from, stretch.to, stretch.apart)),
            }
            last = Some(stretch);
        }
        moves
    }

    fn text(&self) -> String {
        let mut out = String::new();
        // Everything is told in the order of the motion.
        let back = self.sweep.is_backwards();
        let [from, to] = self.sweep.passed();
        let sense = match self.sweep.input {
            InputKind::Angle(_) if back => " (it turns clockwise)",
            _ if back => " (as it is driven)",
            _ => "",
        };
        let _ = writeln!(
            out,
            "{} from {} {}to {}{sense}; {} operations for one position",
            self.input(),
            self.place(from),
            if back { "down " } else { "" },
            self.place(to),
            self.sweep.operations()
        );
        if let Some(why) = &self.unconfirmed {
            let _ = writeln!(out, "not confirmed: {why}");
        }
        let mut moves = self.moves();
        let mut events: Vec<&Event> = self.sweep.events.iter().collect();
        let mut reversals: Vec<_> = self.sweep.reversals.iter().collect();
        if back {
            moves = moves.into_iter().rev().map(|(from, to, apart)| (to, from, apart)).collect();
            events.reverse();
            reversals.reverse();
        }
        for (from, to, apart) in moves {
            let apart = if apart { " (only by taking the mechanism apart)" } else { "" };
            let (from, to) = (self.place(from), self.place(to));
            let _ = writeln!(out, "moves from {from} to {to}{apart}");
        }
        for (asked, why) in &self.sweep.without {
            let _ = writeln!(out, "{}: {}", asked.name, reason(*why));
        }
        for event in events {
            let _ = writeln!(out, "{}", self.event(event));
        }
        for reversal in reversals {
            let _ = writeln!(out, "{}", self.reversal(reversal));
        }
        for part in &self.sweep.ambiguous {
            let [from, to] = part.map(|at| self.place(at));
            let _ =
                writeln!(out, "from {from} to {to} two balances with friction fit: no force is told there");
        }
        for stroke in self.sweep.strokes() {
            let _ = writeln!(out, "{}", self.stroke(&stroke));
        }
        out.push_str(&self.governor());
        if let Some(sheet) = self.cycle {
            out.push_str(&levels_told(self.scene, sheet));
        }
        out
    }

    /// The asked columns.
    fn asked(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.sweep.columns.len()).filter(|&c| !self.sweep.columns[c].watched)
    }

    /// What stands in a row: the asked columns, and of a force its size and its direction behind its components.
    fn cells(&self) -> Vec<Cell> {
        let columns = &self.sweep.columns;
        let mut cells = Vec::new();
        for c in self.asked() {
            cells.push(Cell::Column(c));
            if let (Some(1), Quantity::Force(..)) = (columns[c].axis, columns[c].asked.quantity) {
                cells.extend([Cell::Size(c - 1), Cell::Direction(c - 1)]);
            }
        }
        cells
    }

    /// Heading and unit of a cell.
    fn head_of(&self, cell: Cell) -> (String, String) {
        match cell {
            Cell::Column(c) => (self.sweep.columns[c].name(), self.unit_of(c).symbol.clone()),
            Cell::Size(c) => {
                (format!("{}.size", self.sweep.columns[c].asked.name), self.unit_of(c).symbol.clone())
            }
            Cell::Direction(c) => {
                (format!("{}.direction", self.sweep.columns[c].asked.name), "deg".to_owned())
            }
        }
    }

    /// The number of a cell in its unit.
    fn told(&self, cell: Cell, values: &[Option<f64>]) -> Option<f64> {
        let value = |c: usize| values.get(c).copied().flatten();
        match cell {
            Cell::Column(c) => value(c).map(|v| v / self.unit_of(c).si),
            Cell::Size(c) => value(c).zip(value(c + 1)).map(|(x, y)| libm::hypot(x, y) / self.unit_of(c).si),
            Cell::Direction(c) => {
                let found = value(c).zip(value(c + 1)).filter(|(x, y)| *x != 0.0 || *y != 0.0);
                found.map(|(x, y)| libm::atan2(y, x).to_degrees())
            }
        }
    }

    /// How far that number may be off.
    fn bound_of(&self, cell: Cell, values: &[Option<f64>], bounds: &[f64]) -> Option<f64> {
        let own = |c: usize| values.get(c).copied().flatten().map(|v| self.bound(c, v, bounds[c]));
        match cell {
            Cell::Column(c) => own(c),
            Cell::Size(c) | Cell::Direction(c) => {
                let (x, y) = own(c).zip(own(c + 1))?;
                let size = self.told(Cell::Size(c), values)?;
                let off = libm::hypot(x, y) + 4.0 * size * f64::EPSILON;
                match cell {
                    Cell::Direction(_) if off < size => {
                        Some(libm::asin(off / size).to_degrees() + 360.0 * f64::EPSILON)
                    }
                    Cell::Direction(_) => Some(180.0),
                    _ => Some(off),
                }
            }
        }
    }

    /// A bound in the unit of its column, with the roundings that this costs: the unit's own two and the division's.
    fn bound(&self, column: usize, value: f64, bound: f64) -> f64 {
        let si = self.unit_of(column).si;
        bound / si * (1.0 + f64::EPSILON) + (value / si).abs() * 1.5 * f64::EPSILON
    }

    fn csv(
        &self,
        out: &mut dyn Write,
        places: &[f64],
        bounded: Option<&SweepWithBounds<'_>>,
    ) -> io::Result<()> {
        let cells = self.cells();
        write!(out, "{} [{}]", self.input(), self.unit.symbol)?;
        for cell in &cells {
            let (name, unit) = self.head_of(*cell);
            write!(out, ",{}", quoted(&format!("{name} [{unit}]")))?;
            if bounded.is_some() {
                write!(out, ",{}", quoted(&format!("bound of {name} [{unit}]")))?;
            }
        }
        writeln!(out)?;
        self.each(places, bounded, |at, values, bounds| {
            write!(out, "{}", Plain(at / self.unit.si))?;
            for cell in &cells {
                match self.told(*cell, values) {
                    Some(value) => write!(out, ",{}", Plain(value))?,
                    None => write!(out, ",")?,
                }
                if let Some(bounds) = bounds {
                    match self.bound_of(*cell, values, bounds) {
                        Some(bound) => write!(out, ",{}", Plain(bound))?,
                        None => write!(out, ",")?,
                    }
                }
            }
            writeln!(out)
        })
    }

    /// Whether a place is that of a reversal; after a whole turn it is again.
    fn is_at(&self, reversal: &Reversal, at: f64) -> bool {
        let whole = self.sweep.range[1] - self.sweep.range[0];
        let away = (reversal.at - at).abs();
        away <= 1e-9 * whole || self.sweep.whole_turn && (away - whole).abs() <= 1e-9 * whole
    }

    fn leaps_at(&self, at: f64) -> Option<&Reversal> {
        self.sweep.reversals.iter().find(|reversal| self.is_at(reversal, at))
    }

    /// Every position in order, with the bounds of its numbers where they are wanted.
    fn each(
        &self,
        places: &[f64],
        bounded: Option<&SweepWithBounds<'_>>,
        mut take: impl FnMut(f64, &[Option<f64>], Option<&[f64]>) -> io::Result<()>,
    ) -> io::Result<()> {
        let bar = if places.len() >= MANY && std::io::stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} positions, {eta} left")
                .unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(places.len() as u64).with_style(style)
        } else {
            ProgressBar::hidden()
        };
        let mut numbers = Vec::new();
        let mut leaps =
            self.sweep.reversals.iter().filter(|leap| places.first().is_some_and(|at| leap.at >= *at));
        let mut leap = leaps.next();
        for portion in places.chunks(PORTION) {
            let mut told = Ok(());
            match bounded {
                // Of a place at which forces leap both sides are told.
                None => self.sweep.each_position(portion, |at, values| {
                    let mut here = self.leaps_at(at);
                    while let Some(before) = leap.filter(|leap| told.is_ok() && leap.at <= at) {
                        here = here.filter(|own| !std::ptr::eq(*own, before));
                        let [one, other] = &before.sides;
                        told = take(before.at, one, None).and_then(|()| take(before.at, other, None));
                        leap = leaps.next();
                        if self.is_at(before, at) {
                            return;
                        }
                    }
                    match here {
                        _ if told.is_err() => {}
                        Some(own) => {
                            let [one, other] = &own.sides;
                            told = take(at, one, None).and_then(|()| take(at, other, None));
                            if leap.is_some_and(|leap| std::ptr::eq(leap, own)) {
                                leap = leaps.next();
                            }
                        }
                        None => told = take(at, values, None),
                    }
                }),
                Some(bounded) => bounded.run(portion, |at, values, bounds| {
                    numbers.clear();
                    let known = |(value, bound): (&f64, &f64)| bound.is_finite().then_some(*value);
                    numbers.extend(values.iter().zip(bounds).map(known));
                    if told.is_ok() {
                        told = take(at, &numbers, Some(bounds));
                    }
                }),
            }
            told?;
            bar.inc(portion.len() as u64);
        }
        bar.finish_and_clear();
        Ok(())
    }

    fn json(
        &self,
        out: &mut dyn Write,
        places: &[f64],
        bounded: Option<&SweepWithBounds<'_>>,
    ) -> io::Result<()> {
        let head = serde_json::to_string_pretty(&self.head())?;
        // The positions are the last key of the object, one in a line.
        let head = head.trim_end().strip_suffix('}').unwrap_or_default().trim_end();
        write!(out, "{head},\n  \"positions\": [")?;
        let cells = self.cells();
        let mut first = true;
        self.each(places, bounded, |at, values, bounds| {
            let numbers: Vec<Option<f64>> = cells.iter().map(|cell| self.told(*cell, values)).collect();
            let mut row = json!({ "at": at / self.unit.si, "values": numbers });
            if let Some(bounds) = bounds {
                let within = cells.iter().map(|cell| self.bound_of(*cell, values, bounds));
                row["bounds"] = json!(within.collect::<Vec<Option<f64>>>());
            }
            let comma = if std::mem::take(&mut first) { "" } else { "," };
            write!(out, "{comma}\n    {row}")
        })?;
        writeln!(out, "{}]\n}}", if first { "" } else { "\n  " })
    }

    /// All but the positions.
    fn head(&self) -> Value {
        let unit = |c: usize| self.unit_of(c);
        let columns: Vec<Value> = self
            .cells()
            .into_iter()
            .map(|cell| self.head_of(cell))
            .map(|(name, unit)| json!({ "name": name, "unit": unit }))
            .collect();
        let stretches: Vec<Value> = self
            .moves()
            .into_iter()
            .map(|(from, to, apart)| json!({ "from": from / self.unit.si, "to": to / self.unit.si, "apart": apart }))
            .collect();
        let events: Vec<Value> = self.sweep.events.iter().map(|event| self.event_json(event)).collect();
        let strokes: Vec<Value> = self
            .sweep
            .strokes()
            .iter()
            .map(|s| {
                json!({
                    "name": self.sweep.columns[s.column].name(),
                    "unit": unit(s.column).symbol,
                    "stroke": s.length / unit(s.column).si,
                    "between": s.ends.map(|x| x / self.unit.si),
                    "time_ratio": s.time_ratio,
                })
            })
            .collect();
        let without: Vec<Value> = self
            .sweep
            .without
            .iter()
            .map(|(asked, why)| json!({ "name": asked.name, "why": reason(*why) }))
            .collect();
        let mut head = json!({
            "scene": self.scene.title.in_language("en").unwrap_or(self.file),
            "input": self.input(),
            "unit": self.unit.symbol,
            "range": self.sweep.range.map(|x| x / self.unit.si),
            "moves": stretches,
            "events": events,
            "strokes": strokes,
            "without": without,
            "columns": columns,
        });
        if let Some(why) = &self.unconfirmed {
            head["unconfirmed"] = json!(why);
        }
        if !self.sweep.ambiguous.is_empty() {
            let parts = self.sweep.ambiguous.iter().map(|part| part.map(|at| at / self.unit.si));
            head["ambiguous"] = parts.map(|[from, to]| json!({ "from": from, "to": to })).collect();
        }
        if !self.sweep.reversals.is_empty() {
            let cells = self.cells();
            let side = |values: &[Option<f64>]| -> Vec<Option<f64>> {
                cells.iter().map(|cell| self.told(*cell, values)).collect()
            };
            let told = self.sweep.reversals.iter().map(|reversal| {
                let [before, after] = [0, 1].map(|at| side(&reversal.sides[at]));
                let at = reversal.at / self.unit.si;
                json!({ "at": at, "turns_round": reversal.what, "before": before, "after": after })
            });
            head["reversals"] = told.collect();
        }
        if let Some(sheet) = self.cycle {
            head["cycle"] = levels_json(self.scene, sheet);
        }
        head
    }

    fn event_json(&self, event: &Event) -> Value {
        let at = event.at / self.unit.si;
        let extreme = |kind: &str, column: usize, value: f64| {
            let unit = self.unit_of(column);
            json!({
                "at": at, "kind": kind, "name": self.sweep.name_of_extreme(column),
                "value": value / unit.si, "unit": unit.symbol,
            })
        };
        match event.kind {
            EventKind::Limit => json!({ "at": at, "kind": "limit", "links": self.sweep.links(event) }),
            EventKind::ChangePoint => {
                json!({ "at": at, "kind": "change point", "links": self.sweep.links(event) })
            }
            EventKind::DeadPosition => {
                json!({ "at": at, "kind": "dead position", "links": self.sweep.links(event) })
            }
            EventKind::AtInfinity { centre, direction } => json!({
                "at": at, "kind": "at infinity", "name": self.sweep.centres[centre].asked.name,
                "direction_deg": direction.to_degrees(),
            }),
            EventKind::Least { column, value } => extreme("least", column, value),
            EventKind::Greatest { column, value } => extreme("greatest", column, value),
        }
    }
}
