//! However it is stated, it is the same mechanism.
//!
//! A mechanism is grown over places that are chosen first (`grow.rs`); what it does, constraints written here say
//! (`truth.rs`), which share nothing with the program; one of the many ways to state it is chosen (`statement.rs`); and
//! both solvers must answer with the truth (`judge.rs`).
//!
//! ```sh
//! cargo test --release --no-default-features --test statements -- --ignored --nocapture campaign
//! LINKGRAM_SEED=17 LINKGRAM_CAMPAIGN=1 cargo test … # one scene, printed
//! ```

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod asked;
#[path = "../extremes/dice.rs"]
#[allow(dead_code, reason = "shared with the extremes")]
mod dice;
mod grow;
mod jet;
mod judge;
mod mechanism;
mod minimise;
mod restated;
mod statement;
mod truth;

use std::collections::BTreeMap;

use asked::Asked;
use dice::Dice;
use judge::{Fault, Verdict};
use linkgram::plan::Extent;
use linkgram::sheet::{self, Language, scale};
use mechanism::{length, minus};
use serde_json::Value;
use truth::State;

/// A scene with its truth.
struct Case {
    scene: Value,
    asked: Vec<Asked>,
    made: Vec<&'static str>,
    ways: Vec<&'static str>,
}

/// The mechanism of this seed with its motion, its groups, and the dice that go on; why there is none, otherwise.
fn moving(seed: u64) -> Result<(grow::Growth, State, Dice), &'static str> {
    let mut dice = Dice::new(seed);
    let growth = grow::grow(&mut dice).ok_or("nothing grew")?;
    let state = truth::solve(&growth.mechanism).map_err(|why| match why {
        truth::NoTruth::Mobility { .. } => "another mobility",
        truth::NoTruth::Open(_) => "places that do not close",
        truth::NoTruth::Singular(_) => "next to a dead centre",
    })?;
    Ok((growth, state, dice))
}

/// The scene of this seed; why there is none, otherwise.
fn case(seed: u64) -> Result<Case, &'static str> {
    let (growth, state, mut dice) = moving(seed)?;
    let m = growth.mechanism;
    let said = statement::say(&m, &growth.made, &mut dice);
    let asked = asked::ask(&m, &state, &said, &mut dice);
    if asked.is_empty() {
        return Err("nothing asked");
    }
    let mut made = growth.made;
    made.sort_unstable();
    made.dedup();
    Ok(Case { scene: said.scene, asked, made, ways: said.ways })
}

/// A fault without its names and numbers.
fn class(fault: &Fault) -> String {
    let mut why = String::new();
    let wrong = fault.kind.ends_with("wrong");
    if !wrong {
        for word in fault.why.split_whitespace() {
            let plain = word.trim_matches(|c: char| !c.is_alphanumeric());
            let name = plain.len() <= 2 && plain.starts_with(|c: char| c.is_ascii_uppercase());
            let number = plain.contains(|c: char| c.is_ascii_digit());
            why += if number { "#" } else if name { "P" } else { word };
            why.push(' ');
        }
    }
    format!("{} {why}", fault.kind)
}

/// What comes first of what follows from it.
fn rank(fault: &Fault) -> usize {
    let name = fault.name.as_deref().and_then(|n| n.split('(').next()).unwrap_or("");
    ["", "x", "angle", "v", "omega", "slip", "I", "rub", "a", "alpha"].iter().position(|n| *n == name).unwrap_or(20)
}

/// What a scene consists of.
fn shape(scene: &Value) -> String {
    let links = scene["links"].as_object().unwrap();
    let list = |key: &str| scene.get(key).and_then(Value::as_array).cloned().unwrap_or_default();
    let mut parts = Vec::new();
    let joins = |n: &Value| {
        links.get(&n.to_string()).map_or("block".to_owned(), |l| format!("{}j", l["joins"].as_array().unwrap().len()))
    };
    for slide in list("slides") {
        let rider = if slide.get("link").is_some() { format!("link{}", joins(&slide["link"])) } else if slide.get("block").is_some() { "block".to_owned() } else { "pin".to_owned() };
        let on = if slide["on"]["link"] == 1 { "frame".to_owned() } else { joins(&slide["on"]["link"]) };
        let arc = if slide["on"].get("radius").is_some() { "arc" } else { "" };
        parts.push(format!("{rider}/{on}{arc}"));
    }
    for roll in list("rolls") {
        parts.push(if roll.get("line").is_some() { "rack".to_owned() } else { "wheels".to_owned() });
    }
    parts.sort();
    let mut drives = Vec::new();
    let mut inputs = list("inputs");
    inputs.extend(scene.get("input").cloned());
    for input in inputs {
        let angle = if input.get("angle").is_some() || input.get("at").is_some() { "+at" } else { "" };
        drives.push(if let Some(n) = input.get("link") {
            format!("link{}{angle}", joins(n))
        } else if input["slide"].is_string() {
            format!("pin{angle}")
        } else {
            format!("slide{}{angle}", joins(&input["slide"]))
        });
    }
    let placed = scene.get("placed").is_some();
    let near = scene.get("near").is_some();
    format!("{} links, [{}], by {}{}{}", links.len(), parts.join(" "), drives.join(" & "), if placed { ", placed" } else { "" }, if near { ", near" } else { "" })
}

fn from_environment(name: &str, default: u64) -> u64 {
    std::env::var(name).ok().and_then(|s| s.parse().ok()).unwrap_or(default)
}

/// The equations of the truth say what the places do when they are solved a little later and a little earlier.
#[test]
fn the_truth_is_the_derivative_of_places() {
    let mut held = 0;
    for seed in 0..400 {
        let Ok((growth, state, _)) = moving(seed) else { continue };
        let m = growth.mechanism;
        let turns = (1..m.bodies.len()).map(|b| state.turn(b));
        let points: Vec<_> = m.points.iter().map(|p| state.place(p.of[0], p.at)).collect();
        let size = m.size();
        let mut w = turns.fold(0.0_f64, |w, t| w.max(t.rate.abs()).max(t.second.abs().sqrt()));
        for p in &points {
            w = w.max(length(p.velocity()) / size).max((length(p.acceleration()) / size).sqrt());
        }
        let h = 1e-3 / w;
        let times = [-2.0, -1.0, 1.0, 2.0];
        let states: Option<Vec<State>> = times.iter().map(|t| truth::later(&m, t * h)).collect();
        let states = states.unwrap();
        for (i, p) in m.points.iter().enumerate() {
            let places: Vec<[f64; 2]> = states.iter().map(|s| s.place(p.of[0], p.at).value()).collect();
            for k in [0, 1] {
                let at = |j: usize| places[j][k] - p.at[k];
                let v = (at(0) - 8.0 * at(1) + 8.0 * at(2) - at(3)) / (12.0 * h);
                let a = (-at(0) + 16.0 * at(1) + 16.0 * at(2) - at(3)) / (12.0 * h * h);
                let off = (v - points[i].velocity()[k]).abs() / (size * w);
                assert!(off < 1e-6, "seed {seed}: v({}) is off by {off:e}", p.name);
                let off = (a - points[i].acceleration()[k]).abs() / (size * w * w);
                assert!(off < 1e-5, "seed {seed}: a({}) is off by {off:e}", p.name);
            }
        }
        held += 1;
    }
    assert!(held > 300, "{held} mechanisms");
}

/// The first of the asked quantities of so many scenes, swept and drawn.
#[test]
fn sheets_and_sweeps_of_the_statements() {
    let mut swept = 0;
    for seed in 0..from_environment("LINKGRAM_SHEETS", 120) {
        let Ok(case) = case(seed) else { continue };
        let text = judge::asking(&case.scene, &case.asked).to_string();
        let scene = linkgram::scene::read(&text, "scene.json").unwrap();
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, scale::for_scene);
        let solved = solved.unwrap_or_else(|error| panic!("seed {seed}: {error}\n{text}"));
        let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
        let svg = linkgram::render::svg::write(&figure);
        assert!(!svg.contains("NaN") && !svg.contains("inf"), "seed {seed}: a sheet with no number");
        let Ok(sweep) = linkgram::sweep::Sweep::new(&scene.mechanism, None) else { continue };
        let complaints = judge::at_start(&sweep, &case.asked);
        assert!(complaints.is_empty(), "seed {seed}: {complaints:?}\n{text}");
        swept += 1;
    }
    assert!(swept > 50, "{swept} sweeps");
}

#[test]
#[ignore = "takes minutes"]
fn campaign() {
    let (from, count) = (from_environment("LINKGRAM_SEED", 0), from_environment("LINKGRAM_CAMPAIGN", 2000));
    let out = std::env::var("LINKGRAM_FOUND").ok();
    let mut none: BTreeMap<&str, u64> = BTreeMap::new();
    type Smallest = Option<(usize, u64, Value, String)>;
    let mut classes: BTreeMap<String, (u64, Smallest)> = BTreeMap::new();
    let mut plain: BTreeMap<String, u64> = BTreeMap::new();
    let minimised = from_environment("LINKGRAM_MINIMISED", 10);
    let (mut scenes, mut whole, mut right) = (0_u64, 0_u64, 0_usize);
    let mut by_group: BTreeMap<String, (u64, u64)> = BTreeMap::new();
    std::panic::set_hook(Box::new(|_| {}));
    for seed in from..from + count {
        let case = match case(seed) {
            Ok(case) => case,
            Err(why) => {
                *none.entry(why).or_default() += 1;
                continue;
            }
        };
        scenes += 1;
        let started = std::time::Instant::now();
        let verdict: Verdict = judge::judge(&case.scene, &case.asked);
        if started.elapsed().as_secs_f64() > 1.0 {
            println!("{seed} took {:?}: {:?}", started.elapsed(), case.made);
        }
        right += verdict.right;
        for key in case.made.iter().chain(&case.ways) {
            let counted = by_group.entry((*key).to_owned()).or_default();
            counted.0 += 1;
            counted.1 += u64::from(verdict.faults.is_empty());
        }
        if verdict.faults.is_empty() {
            whole += 1;
        }
        if count == 1 {
            println!("{:#}\n{:?}\n{:#?}", judge::asking(&case.scene, &case.asked), case.made, verdict.faults);
        }
        let Some(fault) = verdict.faults.iter().min_by_key(|f| rank(f)) else { continue };
        let known = class(fault);
        *plain.entry(known.clone()).or_default() += 1;
        if plain[&known] > minimised || started.elapsed().as_secs_f64() > 3.0 {
            continue;
        }
        let (small, why) = minimise::minimise(&case.scene, &case.asked, fault, &known);
        let entry = classes.entry(format!("{known} | {}", shape(&small))).or_default();
        entry.0 += 1;
        let size = small.to_string().len();
        if entry.1.as_ref().is_none_or(|(least, ..)| size < *least) {
            if entry.0 == 1 && let Some(path) = &out {
                let shape = shape(&small);
                let text = format!("## {known} | {shape} (seed {seed}, {:?})\n{why}\n```json\n{small}\n```\n\n", case.made);
                use std::io::Write;
                std::fs::OpenOptions::new().append(true).create(true).open(path).unwrap().write_all(text.as_bytes()).unwrap();
            }
            entry.1 = Some((size, seed, small, why));
        }
    }
    drop(std::panic::take_hook());
    println!("{scenes} scenes, {whole} wholly right; {right} quantities right; no scene: {none:?}");
    for (group, (all, right)) in by_group {
        println!("  {group}: {right} of {all}");
    }
    for (class, times) in &plain {
        println!("{times:6} {class}");
    }
    println!();
    let mut table: Vec<_> = classes.into_iter().collect();
    table.sort_by_key(|(_, entry)| std::cmp::Reverse(entry.0));
    for (class, (times, smallest)) in &table {
        let Some((_, seed, ..)) = smallest else { continue };
        println!("{times:6} {class} ({seed})");
    }
}
