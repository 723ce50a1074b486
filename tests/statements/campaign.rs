//! Many scenes, and a table of what became of them.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use serde_json::Value;

use super::Case;
use super::judge::{Fault, judge};
use super::minimise::minimise;

/// Refusals of the drawing that are not what the truth says: a text of each, and what is missing. A number is never
/// let through.
const OPEN: [(&str, &str); 0] = [];

/// A scene that takes longer is told by its seed.
const SLOW: f64 = 2.0;

/// One scene that shows a fault.
struct Example {
    seed: u64,
    scene: Value,
    why: String,
}

/// How often something went wrong, and the smallest scene in which it does.
#[derive(Default)]
struct Class {
    times: u64,
    first: u64,
    open: bool,
    shapes: BTreeMap<String, (u64, Option<Example>)>,
}

/// What became of many scenes.
#[derive(Default)]
pub(crate) struct Tally {
    scenes: u64,
    whole: u64,
    right: u64,
    none: BTreeMap<&'static str, u64>,
    parts: BTreeMap<String, [u64; 2]>,
    classes: BTreeMap<String, Class>,
    slow: Vec<(u64, f64)>,
}

/// A fault without its names and numbers.
pub(crate) fn class(fault: &Fault) -> String {
    let centre = fault.name.as_deref().is_some_and(|n| n.starts_with("I("));
    let mut why = fault.kind.to_owned() + if centre { " centre:" } else { ":" };
    if fault.kind.ends_with("wrong") {
        return why;
    }
    for word in fault.why.split_whitespace() {
        let plain = word.trim_matches(|c: char| !c.is_alphanumeric());
        let name = plain.len() <= 2 && plain.starts_with(|c: char| c.is_ascii_uppercase());
        let number = plain.contains(|c: char| c.is_ascii_digit());
        why.push(' ');
        why += if number {
            "#"
        } else if name {
            "P"
        } else {
            word
        };
    }
    why
}

/// A class that is known not to hold.
fn is_open(class: &str) -> bool {
    (class.starts_with("graphical ") || class.starts_with("refused"))
        && OPEN.iter().any(|(text, _)| class.contains(text))
}

/// What comes first of what follows from it.
fn rank(fault: &Fault) -> usize {
    let name = fault.name.as_deref().and_then(|n| n.split('(').next()).unwrap_or("");
    let first = ["", "x", "angle", "v", "omega", "slip", "I", "rub", "a", "alpha"];
    first.iter().position(|n| *n == name).unwrap_or(first.len())
}

fn list(scene: &Value, key: &str) -> Vec<Value> {
    scene.get(key).and_then(Value::as_array).cloned().unwrap_or_default()
}

/// Of what a scene consists.
fn shape(scene: &Value) -> String {
    let links = scene["links"].as_object().unwrap();
    let joins = |n: &Value| {
        let link = links.get(&n.to_string()).and_then(|l| l["joins"].as_array());
        link.map_or_else(|| "block".to_owned(), |joins| format!("link of {}", joins.len()))
    };
    let mut parts = Vec::new();
    for slide in list(scene, "slides") {
        let rider = match (slide.get("link"), slide.get("block")) {
            (Some(link), _) => joins(link),
            (None, Some(_)) => "block".to_owned(),
            (None, None) => "pin".to_owned(),
        };
        let on = if slide["on"]["link"] == 1 { "frame".to_owned() } else { joins(&slide["on"]["link"]) };
        let arc = if slide["on"].get("radius").is_some() { " (arc)" } else { "" };
        parts.push(format!("{rider} on {on}{arc}"));
    }
    for roll in list(scene, "rolls") {
        parts.push(if roll.get("line").is_some() { "rack" } else { "wheels" }.to_owned());
    }
    parts.sort();
    let mut inputs = list(scene, "inputs");
    inputs.extend(scene.get("input").cloned());
    let drives: Vec<String> = inputs
        .iter()
        .map(|input| {
            let at = if input.get("angle").is_some() || input.get("at").is_some() { " at" } else { "" };
            match input.get("link") {
                Some(link) => joins(link) + at,
                None if input["slide"].is_string() => format!("slide of a pin{at}"),
                None => format!("slide of {}{at}", joins(&input["slide"])),
            }
        })
        .collect();
    let stands: Vec<&str> = ["placed", "near"].into_iter().filter(|k| scene.get(*k).is_some()).collect();
    format!(
        "{} links; {}; by {}; {}",
        links.len(),
        parts.join(", "),
        drives.join(" and "),
        stands.join(" and ")
    )
}

impl Tally {
    fn take(
        &mut self,
        seed: u64,
        case: Result<&Case, &'static str>,
        faults: &[Fault],
        right: usize,
        minimised: u64,
    ) {
        let case = match case {
            Ok(case) => case,
            Err(why) => {
                *self.none.entry(why).or_default() += 1;
                return;
            }
        };
        self.scenes += 1;
        self.right += right as u64;
        let whole = u64::from(faults.is_empty());
        self.whole += whole;
        for part in case.made.iter().chain(&case.ways) {
            let counted = self.parts.entry((*part).to_owned()).or_default();
            counted[0] += 1;
            counted[1] += whole;
        }
        let Some(fault) = faults.iter().min_by_key(|f| rank(f)) else { return };
        let name = class(fault);
        let entry =
            self.classes.entry(name.clone()).or_insert_with(|| Class { first: u64::MAX, ..Class::default() });
        entry.times += 1;
        entry.first = entry.first.min(seed);
        entry.open = is_open(&name);
        if entry.times > minimised {
            return;
        }
        let (scene, why) = minimise(&case.scene, &case.asked, fault, &name);
        let (times, example) = entry.shapes.entry(shape(&scene)).or_default();
        *times += 1;
        let size = scene.to_string().len();
        if example.as_ref().is_none_or(|e| e.scene.to_string().len() > size) {
            *example = Some(Example { seed, scene, why });
        }
    }

    pub(crate) fn scenes(&self) -> u64 {
        self.scenes
    }

    /// Nothing went wrong but what is known to be open.
    pub(crate) fn is_clean(&self) -> bool {
        self.classes.values().all(|c| c.open)
    }

    /// Counts.
    pub(crate) fn table(&self) -> String {
        let mut out = format!(
            "{} scenes, {} wholly right, {} quantities right; no scene: {:?}\n",
            self.scenes, self.whole, self.right, self.none
        );
        for (class, counted) in &self.classes {
            let _ = writeln!(out, "{:7} {class} (seed {})", counted.times, counted.first);
        }
        for (part, [all, right]) in &self.parts {
            let _ = writeln!(out, "{right:7} of {all} {part}");
        }
        for (seed, seconds) in &self.slow {
            let _ = writeln!(out, "seed {seed} took {seconds:.1} s");
        }
        out
    }

    /// The smallest scene of each kind that shows a fault.
    pub(crate) fn smallest(&self) -> String {
        let mut out = String::new();
        for (class, counted) in &self.classes {
            for (shape, (times, example)) in &counted.shapes {
                if let Some(Example { seed, scene, why }) = example {
                    let _ = write!(
                        out,
                        "## {class} | {shape} ({times} of {}, seed {seed})\n{why}\n{scene}\n\n",
                        counted.times
                    );
                }
            }
        }
        out
    }
}

/// Judges the scenes of these seeds; so many of each class of faults are made as small as they can be.
pub(crate) fn run(seeds: Range<u64>, minimised: u64) -> Tally {
    let tally = Mutex::new(Tally::default());
    let next = AtomicU64::new(seeds.start);
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= seeds.end {
                        break;
                    }
                    let case = super::case(seed);
                    let started = std::time::Instant::now();
                    let verdict =
                        case.as_ref().ok().map(|case| judge(&case.scene, &case.asked)).unwrap_or_default();
                    let seconds = started.elapsed().as_secs_f64();
                    let mut tally = tally.lock().unwrap();
                    tally.take(
                        seed,
                        case.as_ref().map_err(|why| *why),
                        &verdict.faults,
                        verdict.right,
                        minimised,
                    );
                    if seconds > SLOW {
                        tally.slow.push((seed, seconds));
                    }
                }
            });
        }
    });
    tally.into_inner().unwrap()
}
