//! A campaign of random scenes, a tenth of them next to a dead centre as near as they like: no error beyond
//! its bound, no panic, and no bound that is always huge.
//!
//! Three scenes of four are chains of which `chain.rs` knows the truth by a geometry of its own; every fourth has
//! slots, yokes, arcs, gears, racks, rolling wheels, riding links or groups of higher class, from the generator of
//! `tests/pairs`, whose laws hold the drawing to the truth: here the same drawing in a finer arithmetic shows what
//! the doubles have lost.
//!
//! The truth is computed in double-double first, of about 31 digits. That decides wherever the error is less than
//! half of its bound and the truth's own error a millionth of it; 75 digits decide the rest, and are laid beside
//! the 31 in one scene of sixteen.
//!
//! *Conditioning* is what half a unit in the last place of each number of the scene does to an answer, all of them
//! together, and half a unit of the answer itself: no way to compute in doubles can promise less. What is zero by the
//! nature of the mechanism counts as large as the largest answer of the same unit in its scene, and an ε as large as
//! the greatest ω², since it is drawn from normal accelerations. The tape tells its share; in one chain of sixty-four
//! the numbers are moved one after the other, and the bound is held against what comes of that as well.
//!
//! ```sh
//! cargo test --release --no-default-features --features cli --test all -- --ignored --nocapture extremes::campaign
//! LINKGRAM_CAMPAIGN=250000 LINKGRAM_SEED=250000 cargo test …   # the second quarter of a million
//! LINKGRAM_FOUND=found.json cargo test …   # keeps what it has found, and goes on from there the next time
//! ```

use std::collections::BTreeMap;
use std::fmt::Write;
use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicU64, Ordering};

use linkgram::board::Real;
use linkgram::double_double::DoubleDouble;
use linkgram::graphical::{self, Numbers};
use linkgram::mechanism::quantity::{Answer, Quantity};
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::solve::Solved;
use linkgram::wide::Wide;
use proptest::strategy::{Strategy, ValueTree};
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use serde::{Deserialize, Serialize};

use super::chain::{self, QUANTITIES};
use super::dice::Dice;
use crate::pairs::builder;

/// A bound may be so many times the conditioning.
const USEFUL: f64 = 1e4;

/// A number counts on the tape in each place of the drawing where it is read, with the rounding of its way to metres
/// or radians; in an answer in which its places undo each other, as ω's in an ε, the tape's conditioning is greater
/// than that of the number moved in all of them. By no more than this.
const READ_OFTEN: f64 = 64.0;

/// The truth in double-double must be better than the bound by this factor.
const FINER: f64 = 1e-6;

/// An error smaller than this part of its bound is none: what remains of a zero in 75 digits.
const NO_ERROR: f64 = 1e-20;

/// Half of the bounds may be so many times the error.
const MEDIAN: f64 = 100.0;

const UNIT_ROUNDOFF: f64 = f64::EPSILON / 2.0;

/// How many numbers of each size there are, in steps of two parts in a hundred.
#[derive(Default, Clone, Serialize, Deserialize)]
struct Spread(BTreeMap<i32, u64>);

const STEP: f64 = 1.02;

impl Spread {
    fn push(&mut self, ratio: f64) {
        *self.0.entry((libm::log(ratio) / libm::log(STEP)).ceil() as i32).or_default() += 1;
    }

    fn add(&mut self, other: &Self) {
        for (step, count) in &other.0 {
            *self.0.entry(*step).or_default() += count;
        }
    }

    fn count(&self) -> u64 {
        self.0.values().sum()
    }

    /// So many are at most as large as this; zero where there are none.
    fn at(&self, part: f64) -> f64 {
        let rank = (self.count() as f64 * part).ceil() as u64;
        let mut below = 0;
        let reached = self.0.iter().find(|(_, count)| {
            below += **count;
            below >= rank
        });
        reached.map_or(0.0, |(step, _)| libm::pow(STEP, f64::from(*step)))
    }

    fn cells(&self) -> String {
        let parts = [0.5, 0.9, 0.99, 1.0].map(|part| format!("{:8.1}", self.at(part)));
        parts.join(" | ")
    }
}

/// One row of the table.
#[derive(Default, Clone, Serialize, Deserialize)]
struct Row {
    answers: u64,
    refused: u64,
    over_error: Spread,
    over_conditioning: Spread,
}

impl Row {
    fn add(&mut self, other: &Self) {
        self.answers += other.answers;
        self.refused += other.refused;
        self.over_error.add(&other.over_error);
        self.over_conditioning.add(&other.over_conditioning);
    }
}

/// The rows, in the order of the table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
enum Key {
    All,
    /// Chains of up to so many links.
    Links(usize),
    /// Chains of which the flattest crossing has a sine from 10 to this power.
    Flat(i32),
    Pairs,
    Analytic,
}

impl Key {
    fn name(self) -> String {
        match self {
            Self::All => "all".to_owned(),
            Self::Links(links) => format!("chains to {links} links"),
            Self::Flat(decade) => format!("chains, flattest crossing from 1e{decade}"),
            Self::Pairs => "other pairs and groups".to_owned(),
            Self::Analytic => "analytic, to 10 links".to_owned(),
        }
    }
}

const LENGTHS: [usize; 7] = [4, 8, 16, 32, 64, 128, 202];

/// An answer and what is known of it.
struct Judged {
    error: f64,
    bound: f64,
    conditioning: Conditioning,
}

/// What a campaign has found.
#[derive(Default, Serialize, Deserialize)]
struct Found {
    scenes: u64,
    near_singular: u64,
    open: u64,
    /// Answers that needed 75 digits.
    wide: u64,
    #[serde(with = "in_pairs")]
    rows: BTreeMap<Key, Row>,
    /// Errors beyond their bounds.
    beyond: Vec<String>,
    /// Bounds of no use.
    useless: Vec<String>,
    /// What is wrong with the truth or with the conditioning.
    doubtful: Vec<String>,
}

/// JSON has no keys but texts.
mod in_pairs {
    use std::collections::BTreeMap;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{Key, Row};

    pub(super) fn serialize<S: Serializer>(rows: &BTreeMap<Key, Row>, to: S) -> Result<S::Ok, S::Error> {
        rows.iter().collect::<Vec<_>>().serialize(to)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<BTreeMap<Key, Row>, D::Error> {
        Ok(Vec::deserialize(from)?.into_iter().collect())
    }
}

fn numbers(answer: &Answer) -> Option<(Vec<f64>, f64)> {
    match answer {
        Answer::Scalar { value, bound } => Some((vec![*value], *bound)),
        Answer::Vector { value, bound } => Some((value.to_vec(), *bound)),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => None,
    }
}

fn size(value: &[f64]) -> f64 {
    value.iter().fold(0.0, |sum, x| libm::hypot(sum, *x))
}

fn distance<R: Real>(value: &[f64], truth: &[R]) -> f64 {
    value.iter().zip(truth).fold(0.0, |sum, (v, t)| libm::hypot(sum, (R::from_f64(*v) - *t).to_f64()))
}

fn apart(fine: &[DoubleDouble], wide: &[Wide]) -> f64 {
    let parts = fine.iter().zip(wide);
    parts.fold(0.0, |sum, (f, w)| libm::hypot(sum, (Wide::of_double_double(*f) - *w).to_f64()))
}

/// The conditioning of an answer.
#[derive(Clone, Copy)]
struct Conditioning {
    /// What the numbers of the scene bring with them.
    inherited: f64,
    /// The rounding of the answer itself, or of the largest of its unit.
    own: f64,
}

/// The conditioning of each answer; `None` where it is refused.
fn conditioning(scene: &Scene, solved: &mut Solved) -> Vec<Option<Conditioning>> {
    let answers = &solved.solution.construction.answers;
    let sizes: Vec<Option<f64>> =
        answers.iter().map(|r| numbers(&r.answer).map(|(value, _)| size(&value))).collect();
    let asked = &scene.mechanism.asked;
    let turns = sizes.iter().zip(asked).filter(|(_, a)| matches!(a.quantity, Quantity::Omega(_)));
    let fastest = turns.filter_map(|(size, _)| *size).fold(0.0, f64::max);
    let tape = &mut solved.solution.tape;
    let of = |(index, marks): (usize, &Vec<u32>)| {
        sizes[index]?;
        let inherited = marks.iter().fold(0.0, |sum, mark| libm::hypot(sum, tape.inherited(*mark)));
        let alike = sizes.iter().zip(asked).filter(|(_, a)| a.unit.symbol == asked[index].unit.symbol);
        let largest = alike.filter_map(|(size, _)| *size).fold(0.0, f64::max);
        let is_alpha = matches!(asked[index].quantity, Quantity::Alpha(_));
        let largest = if is_alpha { largest.max(fastest * fastest) } else { largest };
        Some(Conditioning { inherited, own: largest * UNIT_ROUNDOFF })
    };
    solved.solution.slots.iter().enumerate().map(of).collect()
}

impl Found {
    fn refuse(&mut self, keys: &[Key]) {
        for key in keys {
            self.rows.entry(*key).or_default().refused += 1;
        }
    }

    fn judge(&mut self, keys: &[Key], judged: Judged, what: &dyn Fn() -> String) {
        let Judged { error, bound, conditioning: Conditioning { inherited, own } } = judged;
        let conditioning = inherited + own;
        // Written so that a not-a-number is beyond.
        let (within, useful) = (error <= bound, bound <= USEFUL * conditioning);
        if !within {
            self.beyond.push(format!("off by {error:e}, bound {bound:e}: {}", what()));
        }
        if !useful {
            self.useless.push(format!("bound {bound:e}, conditioning {conditioning:e}: {}", what()));
        }
        for key in keys {
            let row = self.rows.entry(*key).or_default();
            row.answers += 1;
            row.over_conditioning.push(bound / conditioning);
            if error > NO_ERROR * bound {
                row.over_error.push(bound / error);
            }
        }
    }

    fn run(&mut self, seed: u64) {
        self.scenes += 1;
        if seed % 4 == 3 { self.run_pairs(seed) } else { self.run_chain(seed) }
    }

    fn run_chain(&mut self, seed: u64) {
        let chain = chain::chain(seed);
        self.near_singular += u64::from(chain.is_near_singular);
        let links = LENGTHS.into_iter().find(|most| chain.links <= *most).unwrap_or(usize::MAX);
        let decade = (libm::log10(chain.flat).floor() as i32).min(-1);
        let keys = [Key::All, Key::Links(links), Key::Flat(decade)];
        let scene = read(&chain.text, seed);
        let solved = linkgram::solve::solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene);
        let (Some(truth), Ok(mut solved)) = (chain.truth::<DoubleDouble>(), solved) else {
            // Where arcs miss each other by less than rounding they may be taken to touch.
            if chain.closes {
                (0..QUANTITIES).for_each(|_| self.refuse(&keys));
            } else {
                self.open += 1;
            }
            return;
        };
        let conditioning = conditioning(&scene, &mut solved);
        let answers: Vec<Answer> =
            solved.solution.construction.answers.iter().map(|r| r.answer.clone()).collect();
        let mut wide = (seed.is_multiple_of(16)).then(|| chain.truth::<Wide>().unwrap());
        for (index, answer) in answers.iter().enumerate() {
            let (Some((value, bound)), Some(conditioning)) = (numbers(answer), conditioning[index]) else {
                self.refuse(&keys);
                continue;
            };
            let what = || format!("seed {seed}, quantity {index}: {}", chain.text);
            let mut error = distance(&value, &truth[index]);
            if error > bound / 2.0 {
                let wide = wide.get_or_insert_with(|| chain.truth::<Wide>().unwrap());
                error = distance(&value, &wide[index]);
                self.wide += 1;
            }
            if let Some(wide) = &wide {
                let off = apart(&truth[index], &wide[index]);
                if off > FINER * bound {
                    self.doubtful.push(format!("the truth is off by {off:e}, bound {bound:e}: {}", what()));
                }
            }
            self.judge(&keys, Judged { error, bound, conditioning }, &what);
        }
        if seed.is_multiple_of(64) && chain.links <= 64 {
            for (index, moved) in chain.conditioning().unwrap().into_iter().enumerate() {
                let Some(Conditioning { inherited, .. }) = conditioning[index] else { continue };
                let moved = UNIT_ROUNDOFF * moved;
                let part = inherited / moved;
                if !(0.8..READ_OFTEN).contains(&part) {
                    let what = format!("conditioning {part} of what moving shows: seed {seed}, {index}");
                    self.doubtful.push(what);
                }
                let Some((value, bound)) = numbers(&answers[index]) else { continue };
                let useful = bound <= USEFUL * (moved + size(&value) * UNIT_ROUNDOFF);
                if !useful {
                    self.useless.push(format!("bound {bound:e}, by moving {moved:e}: seed {seed}, {index}"));
                }
            }
        }
        if chain.links <= 10
            && seed.is_multiple_of(20)
            && let Ok(state) = linkgram::solve::solve_analytically(&scene)
        {
            for (index, asked) in scene.mechanism.asked.iter().enumerate() {
                let Some((value, bound)) = numbers(&state.answer(&asked.quantity)) else {
                    self.refuse(&[Key::Analytic]);
                    continue;
                };
                // What the board refuses has no conditioning here.
                let Some(conditioning) = conditioning[index] else { continue };
                let what = || format!("seed {seed}, analytic, quantity {index}: {}", chain.text);
                let error = distance(&value, &truth[index]);
                let judged = Judged { error, bound, conditioning };
                self.judge(&[Key::Analytic], judged, &what);
            }
        }
    }

    fn run_pairs(&mut self, seed: u64) {
        let keys = [Key::All, Key::Pairs];
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &Dice::new(seed).seed());
        let mut runner = TestRunner::new_with_rng(Config::default(), rng);
        let plan = builder::plan(3).new_tree(&mut runner).unwrap().current();
        let Some(made) = builder::build(&plan) else {
            self.open += 1;
            return;
        };
        let text = made.scene.to_string();
        let scene = read(&text, seed);
        let Ok(mut solved) = linkgram::solve::solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene)
        else {
            scene.mechanism.asked.iter().for_each(|_| self.refuse(&keys));
            return;
        };
        let conditioning = conditioning(&scene, &mut solved);
        let fine = again::<DoubleDouble>(&scene, &solved);
        let mut wide = (seed % 16 == 15).then(|| again::<Wide>(&scene, &solved));
        let answers = &solved.solution.construction.answers;
        for (index, reading) in answers.iter().enumerate() {
            let (Some((value, bound)), Some(conditioning)) = (numbers(&reading.answer), conditioning[index])
            else {
                self.refuse(&keys);
                continue;
            };
            let what = || format!("seed {seed}, {}: {text}", scene.mechanism.asked[index].name);
            let mut error = f64::NAN;
            if let Some(Numbers { value: truth, bound: Some(own) }) = &fine[index]
                && *own <= FINER * bound
            {
                error = distance(&value, truth);
            }
            // Where the doubles know an answer to the last digit, its bound may be zero.
            let decided = error <= bound / 2.0 || bound == 0.0;
            if !decided || wide.is_some() {
                let wide = wide.get_or_insert_with(|| again::<Wide>(&scene, &solved));
                let Some(Numbers { value: truth, .. }) = &wide[index] else {
                    self.doubtful.push(format!("75 digits refuse {}", what()));
                    continue;
                };
                self.wide += u64::from(!decided);
                let fine_error = error;
                error = distance(&value, truth);
                if decided && (error - fine_error).abs() > FINER * bound {
                    self.doubtful.push(format!("75 digits say {error:e}, 31 {fine_error:e}: {}", what()));
                }
            }
            self.judge(&keys, Judged { error, bound, conditioning }, &what);
        }
    }

    fn add(&mut self, other: Self) {
        self.scenes += other.scenes;
        self.near_singular += other.near_singular;
        self.open += other.open;
        self.wide += other.wide;
        self.beyond.extend(other.beyond);
        self.useless.extend(other.useless);
        self.doubtful.extend(other.doubtful);
        for (key, row) in other.rows {
            self.rows.entry(key).or_default().add(&row);
        }
    }

    fn table(&self) -> String {
        let all = self.rows.get(&Key::All).cloned().unwrap_or_default();
        let mut out = format!(
            "{} scenes, {} of them near singular; {} answers, {} refused, {} scenes that do not close; {} answers \
             needed 75 digits; {} errors beyond their bounds, {} bounds of no use\n\n\
             | | answers | refused | bound over error: median | 90 of 100 | 99 of 100 | greatest | \
             bound over conditioning: median | 90 of 100 | 99 of 100 | greatest |\n\
             |---|---|---|---|---|---|---|---|---|---|---|\n",
            self.scenes,
            self.near_singular,
            all.answers,
            all.refused,
            self.open,
            self.wide,
            self.beyond.len(),
            self.useless.len(),
        );
        for (key, row) in &self.rows {
            let _ = writeln!(
                out,
                "| {} | {} | {} | {} | {} |",
                key.name(),
                row.answers,
                row.refused,
                row.over_error.cells(),
                row.over_conditioning.cells()
            );
        }
        out
    }
}

fn read(text: &str, seed: u64) -> Scene {
    match linkgram::scene::read(text, "campaign") {
        Ok(scene) => scene,
        Err(error) => panic!("seed {seed}: {error}\n{text}"),
    }
}

/// The same drawing in another arithmetic.
fn again<R: Real>(scene: &Scene, solved: &Solved) -> Vec<Option<Numbers<R>>> {
    let drawn = graphical::recorded::<R>(&scene.mechanism, &solved.structure, &solved.plan, solved.scales);
    drawn.unwrap_or_else(|_| scene.mechanism.asked.iter().map(|_| None).collect())
}

/// Runs the scenes of these numbers, on all processors that there are for it.
fn found_in(seeds: Range<u64>) -> Found {
    let next = AtomicU64::new(seeds.start);
    let all = Mutex::new(Found::default());
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                let mut own = Found::default();
                loop {
                    let seed = next.fetch_add(1, Ordering::Relaxed);
                    if seed >= seeds.end {
                        break;
                    }
                    own.run(seed);
                }
                all.lock().unwrap().add(own);
            });
        }
    });
    all.into_inner().unwrap()
}

fn judge(found: &Found) {
    println!("{}", found.table());
    for line in [&found.beyond, &found.useless, &found.doubtful].into_iter().flat_map(|l| l.iter().take(4)) {
        println!("{line}");
    }
    assert!(found.beyond.is_empty(), "{} errors beyond their bounds", found.beyond.len());
    assert!(found.useless.is_empty(), "{} bounds of no use", found.useless.len());
    assert!(found.doubtful.is_empty(), "{} truths in doubt", found.doubtful.len());
    for (key, row) in found.rows.iter().filter(|(_, row)| row.answers > 500) {
        let median = row.over_error.at(0.5);
        assert!(median <= MEDIAN, "{}: half of the bounds are above {median} errors", key.name());
    }
    let all = &found.rows[&Key::All];
    assert!(all.refused * 20 < all.answers, "{} of {} refused", all.refused, all.answers);
}

fn number(name: &str, otherwise: u64) -> u64 {
    std::env::var(name).ok().and_then(|text| text.parse().ok()).unwrap_or(otherwise)
}

#[test]
fn a_sample_of_the_campaign() {
    let found = found_in(0..1500);
    judge(&found);
    assert!(found.rows[&Key::All].answers > 6000);
}

#[test]
#[ignore = "a quarter of an hour on one core; see the head of this file"]
fn the_whole_campaign() {
    /// After so many scenes what was found is written down.
    const PART: u64 = 10_000;
    let first = number("LINKGRAM_SEED", 0);
    let last = first + number("LINKGRAM_CAMPAIGN", 1_000_000);
    let kept = std::env::var_os("LINKGRAM_FOUND");
    let before = kept.as_ref().and_then(|path| std::fs::read(path).ok());
    let mut found: Found = before.map_or_else(Found::default, |text| serde_json::from_slice(&text).unwrap());
    let mut next = first + found.scenes;
    while next < last {
        let end = last.min(next + PART);
        found.add(found_in(next..end));
        next = end;
        if let Some(path) = &kept {
            std::fs::write(path, serde_json::to_vec(&found).unwrap()).unwrap();
        }
    }
    judge(&found);
}
