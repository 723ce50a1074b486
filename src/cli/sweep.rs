//! `linkgram sweep`.

use std::fmt::Write as _;
use std::io::{self, IsTerminal, Write};
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::{Ending, Failure, print, read_scene};
use crate::check::{SweepUnconfirmed, confirm_sweep};
use crate::files;
use crate::live::{Live, LiveError};
use crate::mechanism::friction::Friction;
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::render::{self, Format};
use crate::report::{diagnose, short};
use crate::scene::{Scene, Subject};
use crate::solve::SolveError;
use crate::sweep::{
    Event, EventKind, InputKind, Over, SliderStroke, Stretch, Sweep, SweepError, SweepWithBounds, Without,
};

/// More positions than this show a progress bar.
const MANY: usize = 100_000;
/// So many are computed between two movements of the bar.
const PORTION: usize = 50_000;

/// What to sweep and where to write it.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) steps: Option<u32>,
    pub(super) tolerance: Option<f64>,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    pub(super) over: Over,
    pub(super) bounds: bool,
    pub(super) unchecked: bool,
    pub(super) rubs: bool,
    pub(super) only: Option<String>,
    pub(super) lang: Option<String>,
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
    if !job.rubs {
        scene.mechanism.forces.friction = Friction::default();
    }
    let scene = &scene;
    let language = match &job.lang {
        Some(tag) => super::language(tag)?,
        None => crate::drawing::language(scene),
    };
    let unit = unit_of(scene, job.over);
    let stated = match (job.from, job.to) {
        (None, None) => None,
        (Some(from), Some(to)) => Some([from * unit.si, to * unit.si]),
        _ => return Err(Failure("give both --from and --to, in the scene's units".to_owned())),
    };
    let mut sweep = Sweep::over(job.over, &scene.mechanism, stated).map_err(|error| refusal(scene, error))?;
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
            sweep = Sweep::over(job.over, &outputs_only, stated).map_err(|error| refusal(scene, error))?;
        }
    }
    let sweep = sweep;
    let mut report = Report { file: &file, scene, sweep: &sweep, unit: &unit, unconfirmed: None };
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
        crate::sheet::diagrams::of_sweep_with(scene, &sweep, language, report.unconfirmed.as_deref())
    });
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

/// The drawing as a page runs it.
fn live(
    job: &Job,
    scene: &Scene,
    stated: Option<[f64; 2]>,
    language: crate::sheet::Language,
) -> Result<Vec<u8>, Failure> {
    let live = Live::of(scene, job.over, stated).map_err(|error| match error {
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
    let report = Report { file: scene.source.file(), scene, sweep, unit, unconfirmed: None };
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

struct Report<'s> {
    file: &'s str,
    scene: &'s Scene,
    sweep: &'s Sweep,
    unit: &'s Unit,
    /// What the independent solver does not confirm.
    unconfirmed: Option<String>,
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
            SweepUnconfirmed::Stuck { at, why } => format!("at {} {why}", self.place(*at)),
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
        match self.sweep.input {
            InputKind::Angle(link) => format!("angle of link {}", self.scene.mechanism.link(link).number),
            InputKind::Slide(slide) => format!("place of slide {}", slide + 1),
            InputKind::Time => "time".to_owned(),
        }
    }

    fn event(&self, event: &Event) -> String {
        let links: Vec<String> = self.sweep.links(event).iter().map(u32::to_string).collect();
        let blame =
            if links.is_empty() { String::new() } else { format!(": links {} in line", links.join(" and ")) };
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
        let _ = writeln!(
            out,
            "{} from {} to {}; {} operations for one position",
            self.input(),
            self.place(self.sweep.range[0]),
            self.place(self.sweep.range[1]),
            self.sweep.operations()
        );
        if let Some(why) = &self.unconfirmed {
            let _ = writeln!(out, "not confirmed: {why}");
        }
        for (from, to, apart) in self.moves() {
            let apart = if apart { " (only by taking the mechanism apart)" } else { "" };
            let (from, to) = (self.place(from), self.place(to));
            let _ = writeln!(out, "moves from {from} to {to}{apart}");
        }
        for (asked, why) in &self.sweep.without {
            let _ = writeln!(out, "{}: {}", asked.name, reason(*why));
        }
        for event in &self.sweep.events {
            let _ = writeln!(out, "{}", self.event(event));
        }
        for stroke in self.sweep.strokes() {
            let _ = writeln!(out, "{}", self.stroke(&stroke));
        }
        out
    }

    /// The asked columns.
    fn asked(&self) -> impl Iterator<Item = usize> + '_ {
        (0..self.sweep.columns.len()).filter(|&c| !self.sweep.columns[c].watched)
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
        write!(out, "{} [{}]", self.input(), self.unit.symbol)?;
        for c in self.asked() {
            let (name, unit) = (self.sweep.columns[c].name(), &self.unit_of(c).symbol);
            write!(out, ",{}", quoted(&format!("{name} [{unit}]")))?;
            if bounded.is_some() {
                write!(out, ",{}", quoted(&format!("bound of {name} [{unit}]")))?;
            }
        }
        writeln!(out)?;
        self.each(places, bounded, |at, values, bounds| {
            write!(out, "{}", Plain(at / self.unit.si))?;
            for c in self.asked() {
                let value = values.get(c).copied().flatten();
                match value {
                    Some(value) => write!(out, ",{}", Plain(value / self.unit_of(c).si))?,
                    None => write!(out, ",")?,
                }
                if let Some(bounds) = bounds {
                    match value {
                        Some(value) => write!(out, ",{}", Plain(self.bound(c, value, bounds[c])))?,
                        None => write!(out, ",")?,
                    }
                }
            }
            writeln!(out)
        })
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
        for portion in places.chunks(PORTION) {
            let mut told = Ok(());
            match bounded {
                None => self.sweep.each_position(portion, |at, values| {
                    if told.is_ok() {
                        told = take(at, values, None);
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
        let mut first = true;
        self.each(places, bounded, |at, values, bounds| {
            let unit = |c: usize| self.unit_of(c).si;
            let value = |c: usize| values.get(c).copied().flatten();
            let numbers: Vec<Option<f64>> = self.asked().map(|c| value(c).map(|v| v / unit(c))).collect();
            let mut row = json!({ "at": at / self.unit.si, "values": numbers });
            if let Some(bounds) = bounds {
                let within = |c: usize| value(c).map(|v| self.bound(c, v, bounds[c]));
                row["bounds"] = json!(self.asked().map(within).collect::<Vec<Option<f64>>>());
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
            .asked()
            .map(|c| json!({ "name": self.sweep.columns[c].name(), "unit": unit(c).symbol }))
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
