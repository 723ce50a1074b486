//! However it is stated, it is the same mechanism.
//!
//! A mechanism is grown over places that are chosen first (`grow.rs`); what it does, constraints written here say
//! (`truth.rs`), which share nothing with the program; one of the many ways to state it is chosen (`statement.rs`); and
//! both solvers must answer with the truth (`judge.rs`).
//!
//! ```sh
//! cargo test --release --no-default-features --features cli --test all statements:: -- --ignored --nocapture
//! LINKGRAM_SEED=17 LINKGRAM_CAMPAIGN=1 cargo test … # one scene, printed
//! LINKGRAM_SEEDS=17,23,541 cargo test … # these, a line each
//! ```

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod asked;
mod campaign;
mod facts;
mod figure;
mod grow;
mod jet;
mod judge;
mod kept;
mod mechanism;
mod minimise;
mod restated;
mod statement;
mod truth;
mod units;

use crate::extremes::dice::Dice;
use asked::Asked;
use linkgram::plan::Extent;
use linkgram::sheet::{self, Language, scale};
use mechanism::length;
use serde_json::Value;
use truth::State;

/// From this seed on places are said as a figure says them, too.
const BY_FIGURE: u64 = 1_000_000;

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

/// The text of the scene of this seed, of those that both solvers answer rightly.
pub(crate) fn right_scene(seed: u64) -> Option<String> {
    let case = case(seed).ok()?;
    let right = judge::judge(&case.scene, &case.asked).faults.is_empty();
    right.then(|| judge::asking(&case.scene, &case.asked).to_string())
}

/// The scene of this seed; why there is none, otherwise.
fn case(seed: u64) -> Result<Case, &'static str> {
    let (growth, state, mut dice) = moving(seed)?;
    let m = growth.mechanism;
    let mut said = statement::say(&m, &growth.made, state.condition, &mut dice);
    if !truth::tells_places(&m, &said.told) {
        // A link of placed points rides as placed: how it is turned against its guide only the guide's own places say.
        return Err("a rider as placed whose guide nothing places");
    }
    if seed >= BY_FIGURE {
        let mut dice = Dice::new(seed ^ BY_FIGURE);
        said.ways.extend(figure::restate(&mut said.scene, &m, said.units, &mut dice));
    }
    let asked = asked::ask(&m, &state, &said, &mut dice);
    if asked.is_empty() {
        return Err("nothing asked");
    }
    let mut made = growth.made;
    made.sort_unstable();
    made.dedup();
    Ok(Case { scene: said.scene, asked, made, ways: said.ways })
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

/// Whole sheets of a sample, which the independent solver confirms, and their sweeps: at the place from which they start they
/// have the truth, and along all of them the independent solver finds its way and does not contradict.
#[test]
fn sheets_and_sweeps_of_the_statements() {
    let (mut drawn, mut swept) = (0, 0);
    let mut complaints = Vec::new();
    let from = from_environment("LINKGRAM_SEED", 0);
    for seed in from..from + from_environment("LINKGRAM_SHEETS", 120) {
        let Ok(case) = case(seed) else { continue };
        if !judge::judge(&case.scene, &case.asked).faults.is_empty() {
            continue;
        }
        let text = judge::asking(&case.scene, &case.asked).to_string();
        let scene = linkgram::scene::read(&text, "scene.json").unwrap();
        match linkgram::solve::solve(&scene, Extent::WholeSkeleton, scale::for_scene) {
            Ok(solved) => {
                let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
                let svg = linkgram::render::svg::write(&figure);
                if svg.contains("NaN") || svg.contains("\"inf") {
                    complaints.push(format!("seed {seed}: the sheet has no number\n{text}"));
                }
                if let Err(why) = linkgram::check::confirm(&scene, &solved) {
                    complaints.push(format!("seed {seed}: the sheet is not confirmed: {why}\n{text}"));
                }
                drawn += 1;
            }
            Err(error) => complaints.push(format!("seed {seed}: {error}\n{text}")),
        }
        let sweep = match linkgram::sweep::Sweep::new(&scene.mechanism, None) {
            Ok(sweep) => sweep,
            Err(why) => {
                println!("seed {seed} is not swept: {why}");
                continue;
            }
        };
        let found = judge::at_start(&sweep, &case.asked);
        if !found.is_empty() {
            complaints.push(format!("seed {seed}: {found:?}\n{text}"));
        }
        if let Err(why) = linkgram::check::confirm_sweep(&sweep) {
            complaints.push(format!("seed {seed}: the sweep is not confirmed: {why:?}\n{text}"));
        }
        swept += 1;
    }
    assert!(complaints.is_empty(), "{} complaints\n{}", complaints.len(), complaints.join("\n\n"));
    assert!(drawn > 60 && swept > 40, "{drawn} sheets, {swept} sweeps");
}

/// Both solvers give the truth of every statement. Few of them while some take seconds; the campaign takes more.
#[test]
fn every_statement_has_the_truth() {
    let tally = campaign::run(0..from_environment("LINKGRAM_SAMPLE", 280), 2);
    println!("{}", tally.table());
    let by_figure = campaign::run(BY_FIGURE..BY_FIGURE + from_environment("LINKGRAM_SAMPLE", 280) / 2, 2);
    println!("{}", by_figure.table());
    assert!(by_figure.is_clean(), "{}\n{}", by_figure.table(), by_figure.smallest());
    assert!(tally.scenes() > 200, "{}", tally.table());
    assert!(tally.is_clean(), "{}\n{}", tally.table(), tally.smallest());
}

#[test]
#[ignore = "takes minutes"]
fn campaign() {
    let from = from_environment("LINKGRAM_SEED", 0);
    let count = from_environment("LINKGRAM_CAMPAIGN", 100_000);
    if let Ok(seeds) = std::env::var("LINKGRAM_SEEDS") {
        for seed in seeds.split([',', ' ']).filter_map(|s| s.parse().ok()) {
            let faults = case(seed).map(|case| judge::judge(&case.scene, &case.asked).faults);
            let state = match faults.as_deref() {
                Ok([]) => "right".to_owned(),
                Ok([first, ..]) => {
                    format!("{} {}: {}", first.kind, first.name.as_deref().unwrap_or(""), first.why)
                }
                Err(why) => (*why).to_owned(),
            };
            println!("{seed} {state}");
        }
        return;
    }
    if count == 1 {
        let case = case(from).unwrap();
        let faults = judge::judge(&case.scene, &case.asked).faults;
        println!("{:#}\n{:?}", judge::asking(&case.scene, &case.asked), case.made);
        case.asked.iter().for_each(|a| println!("{} = {:?}", a.name, a.truth));
        println!("{faults:#?}");
        return;
    }
    let tally = campaign::run(from..from + count, from_environment("LINKGRAM_MINIMISED", 10));
    println!("{}", tally.table());
    if let Ok(path) = std::env::var("LINKGRAM_FOUND") {
        std::fs::write(path, tally.smallest()).unwrap();
    }
    assert!(tally.is_clean(), "{}", tally.smallest());
}
