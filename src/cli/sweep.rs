//! `linkgram sweep`.

use std::fmt::Write;
use std::io::IsTerminal;
use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use serde_json::{Value, json};

use super::{Ending, Failure, print, read_scene};
use crate::files;
use crate::mechanism::quantity::Quantity;
use crate::report::{diagnose, short};
use crate::scene::{Scene, Subject};
use crate::solve::SolveError;
use crate::sweep::{Event, EventKind, InputKind, Stroke, Sweep, SweepError};

/// More positions than this show a progress bar.
const MANY: usize = 100_000;
/// So many are reckoned between two movements of the bar.
const PORTION: usize = 50_000;

/// What to sweep and where to write it.
pub(super) struct Job {
    pub(super) scene: PathBuf,
    pub(super) steps: Option<u32>,
    pub(super) tolerance: Option<f64>,
    pub(super) from: Option<f64>,
    pub(super) to: Option<f64>,
    pub(super) output: Vec<PathBuf>,
}

/// Steps where neither they nor a tolerance are stated.
const STEPS: u32 = 36;

enum Format {
    Csv,
    Json,
    Svg,
}

impl Format {
    fn of(path: &Path) -> Result<Self, Failure> {
        match path.extension().and_then(|e| e.to_str()) {
            Some("csv") => Ok(Self::Csv),
            Some("json") => Ok(Self::Json),
            Some("svg") => Ok(Self::Svg),
            _ => Err(Failure(format!("{}: a sweep is written as .csv, .json or .svg", path.display()))),
        }
    }
}

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let formats: Vec<Format> = job.output.iter().map(|path| Format::of(path)).collect::<Result<_, _>>()?;
    let (file, scene) = read_scene(&job.scene)?;
    let scene = &scene;
    let unit = input_unit(scene);
    let stated = match (job.from, job.to) {
        (None, None) => None,
        (Some(from), Some(to)) => Some([from * unit.si, to * unit.si]),
        _ => return Err(Failure("give both --from and --to, in the scene's units".to_owned())),
    };
    let sweep = Sweep::new(&scene.mechanism, stated).map_err(|error| refusal(scene, error))?;
    let report = Report { file: &file, scene, sweep: &sweep, unit: &unit };
    if job.output.is_empty() {
        print(&report.text())?;
        return Ok(Ending::Fine);
    }
    let places = match (job.steps, job.tolerance) {
        (steps, None) => sweep.equal_steps(steps.unwrap_or(STEPS)),
        (None, Some(tolerance)) => sweep.adapted(tolerance),
        (Some(_), Some(_)) => return Err(Failure("give --steps or --tolerance, not both".to_owned())),
    };
    let mut written = Vec::new();
    for (path, format) in job.output.iter().zip(&formats) {
        let text = match format {
            Format::Csv => report.csv(&places),
            Format::Json => {
                serde_json::to_string_pretty(&report.json(&places)).map_err(|e| Failure(e.to_string()))?
                    + "\n"
            }
            Format::Svg => {
                let figure = crate::sheet::diagrams::of_sweep(scene, &sweep);
                crate::render::svg::write(&figure)
            }
        };
        written.push((path.clone(), text.into_bytes()));
    }
    files::write_all(&written)?;
    Ok(Ending::Fine)
}

/// The unit of the input, by its kind.
fn input_unit(scene: &Scene) -> crate::mechanism::quantity::Unit {
    match scene.mechanism.inputs.first() {
        Some(crate::mechanism::Input::Slide { .. }) => scene.units.length.clone(),
        _ => scene.units.angle.clone(),
    }
}

fn refusal(scene: &Scene, error: SweepError) -> Failure {
    match error {
        SweepError::Structure(error) => diagnose(scene, &SolveError::Structure(error)).into(),
        SweepError::Draw(crate::graphical::DrawError::NoConstruction { .. }) => scene
            .source
            .complain(
                Subject::Inputs,
                "a group of higher class is solved by trial, which a sweep cannot do yet".to_owned(),
                Some("drive another link, so that the mechanism falls apart into dyads".to_owned()),
            )
            .into(),
        SweepError::Draw(error) => diagnose(scene, &SolveError::Draw(error)).into(),
        error => scene.source.complain(Subject::Inputs, error.to_string(), None).into(),
    }
}

struct Report<'s> {
    file: &'s str,
    scene: &'s Scene,
    sweep: &'s Sweep,
    unit: &'s crate::mechanism::quantity::Unit,
}

impl Report<'_> {
    fn place(&self, at: f64) -> String {
        // What is left of zero after roots are found is rounding of the range.
        let size = self.sweep.range[0].abs().max(self.sweep.range[1].abs());
        let at = if at.abs() < 64.0 * f64::EPSILON * size { 0.0 } else { at };
        format!("{} {}", short(at / self.unit.si), self.unit.symbol)
    }

    /// Name and value of a column, in its unit.
    fn column(&self, index: usize, value: f64) -> String {
        let column = &self.sweep.columns[index];
        let unit = self.unit_of(index);
        format!("{} = {} {}", column.name(), short(value / unit.si), unit.symbol)
    }

    /// What the sweep added itself is told in the scene's unit.
    fn unit_of(&self, index: usize) -> &crate::mechanism::quantity::Unit {
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
            EventKind::Least { column, value } => format!("least {}", self.column(column, value)),
            EventKind::Greatest { column, value } => format!("greatest {}", self.column(column, value)),
        };
        format!("{}: {what}", self.place(event.at))
    }

    fn stroke(&self, stroke: &Stroke) -> String {
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
        for stretch in &self.sweep.stretches {
            let apart = if stretch.apart { " (only by taking the mechanism apart)" } else { "" };
            let (from, to) = (self.place(stretch.from), self.place(stretch.to));
            let _ = writeln!(out, "moves from {from} to {to}{apart}");
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

    fn csv(&self, places: &[f64]) -> String {
        let mut out = format!("{} [{}]", self.input(), self.unit.symbol);
        for c in self.asked() {
            let _ = write!(out, ",{} [{}]", self.sweep.columns[c].name(), self.unit_of(c).symbol);
        }
        out.push('\n');
        self.each(places, |at, values| {
            let _ = write!(out, "{}", at / self.unit.si);
            for c in self.asked() {
                out.push(',');
                if let Some(value) = values[c] {
                    let _ = write!(out, "{}", value / self.unit_of(c).si);
                }
            }
            out.push('\n');
        });
        out
    }

    fn each(&self, places: &[f64], mut take: impl FnMut(f64, &[Option<f64>])) {
        let bar = if places.len() >= MANY && std::io::stderr().is_terminal() {
            let style = ProgressStyle::with_template("{bar:40} {pos}/{len} positions, {eta} left")
                .unwrap_or_else(|_| ProgressStyle::default_bar());
            ProgressBar::new(places.len() as u64).with_style(style)
        } else {
            ProgressBar::hidden()
        };
        for portion in places.chunks(PORTION) {
            for position in self.sweep.positions(portion) {
                take(position.at, &position.values);
            }
            bar.inc(portion.len() as u64);
        }
        bar.finish_and_clear();
    }

    fn json(&self, places: &[f64]) -> Value {
        let unit = |c: usize| self.unit_of(c);
        let columns: Vec<Value> = self
            .asked()
            .map(|c| json!({ "name": self.sweep.columns[c].name(), "unit": unit(c).symbol }))
            .collect();
        let mut rows = Vec::with_capacity(places.len());
        self.each(places, |at, values| {
            let numbers: Vec<Option<f64>> = self.asked().map(|c| values[c].map(|v| v / unit(c).si)).collect();
            rows.push(json!({ "at": at / self.unit.si, "values": numbers }));
        });
        let stretches: Vec<Value> = self
            .sweep
            .stretches
            .iter()
            .map(|s| json!({ "from": s.from / self.unit.si, "to": s.to / self.unit.si, "apart": s.apart }))
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
        json!({
            "scene": self.scene.title.in_language("en").unwrap_or(self.file),
            "input": self.input(),
            "unit": self.unit.symbol,
            "range": self.sweep.range.map(|x| x / self.unit.si),
            "moves": stretches,
            "events": events,
            "strokes": strokes,
            "columns": columns,
            "positions": rows,
        })
    }

    fn event_json(&self, event: &Event) -> Value {
        let at = event.at / self.unit.si;
        let extreme = |kind: &str, column: usize, value: f64| {
            let unit = self.unit_of(column);
            json!({
                "at": at, "kind": kind, "name": self.sweep.columns[column].name(),
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
            EventKind::Least { column, value } => extreme("least", column, value),
            EventKind::Greatest { column, value } => extreme("greatest", column, value),
        }
    }
}
