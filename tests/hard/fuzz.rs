//! A fuzzer over all rooms: scenes of the project and its catalogue with mutations, answers and drawings to them. What
//! must hold of each input: no panic; no number that is none; a moment; where both solvers answer, they agree.
//!
//! A sample runs with every `cargo test`; `LINKGRAM_FUZZ=1000000 LINKGRAM_FUZZ_SEED=7 cargo test --release --test all
//! hard::fuzz::campaign -- --ignored --nocapture` runs a campaign and, with `LINKGRAM_FUZZ_KEEP=DIR`, keeps what fails.
//! `readers.rs` does the same to the three readers alone, `commands.rs` to whole commands.

use std::cell::RefCell;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Arc, Mutex, Once};
use std::time::{Duration, Instant};

use linkgram::check::{self, Agreement};
use linkgram::drawing::{self, Kind, Wish};
use linkgram::grade::{self, GradeSettings};
use linkgram::graphical::Draughtsmen;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::render;
use linkgram::scene::{self, Scene};
use linkgram::sheet::{self, Language};
use linkgram::solve::{self, Arithmetic, Settings, Solved};
use linkgram::sweep::{Over, Sweep};

use super::Clock;
use super::dice::Dice;
use super::mutation;
use crate::common;

/// How many inputs every `cargo test` tries.
const SAMPLE: u64 = 1_500;
/// Hardly optimised.
pub(crate) const PATIENT: Duration = Duration::from_secs(20);
/// What one input may take in a campaign, which is optimised and alone.
const TWO_SECONDS: Duration = Duration::from_secs(2);
/// What all of a campaign may hold (KiB).
const MEMORY: u64 = 256 << 10;

/// What became of all inputs.
#[derive(Debug, Default, Clone)]
pub(crate) struct Tally {
    inputs: u64,
    pub(crate) scenes: u64,
    solved: u64,
    both_answered: u64,
    figures: u64,
    sweeps: u64,
    graded: u64,
    /// Texts that a reader took, and those that it refused.
    pub(crate) taken: [u64; 2],
    /// Commands, by their exit status.
    pub(crate) ended: [u64; 3],
    slowest_ms: u128,
}

/// Examples and catalogue.
pub(crate) fn seeds() -> Vec<String> {
    let examples = common::example_paths().into_iter().map(|path| std::fs::read_to_string(path).unwrap());
    examples.chain(linkgram::catalogue::KINDS.iter().map(|kind| kind.scene.to_owned())).collect()
}

/// Words that no text of ours has, unless the input brings them.
pub(crate) fn numbers_that_are_none(what: &str, text: &str, input: &str) {
    let input = input.to_lowercase();
    for word in text.split(|c: char| !c.is_alphanumeric()) {
        let word = word.to_lowercase();
        let none = ["nan", "inf"].contains(&word.as_str());
        assert!(!none || input.contains(&word), "{what} says {word}: {}", around(text, &word));
    }
}

/// A drawing without the bytes of its typefaces, which spell any word.
fn without_typefaces(svg: &str) -> String {
    let mut parts = svg.split("base64,");
    let first = parts.next().unwrap_or_default().to_owned();
    parts.fold(first, |told, part| told + part.find([')', '"']).map_or("", |end| &part[end..]))
}

#[test]
fn only_the_bytes_of_typefaces_are_left_out() {
    let svg = "<a u=\"1\"/>url(data:font/woff2;base64,Ewn+inf+Jf) <b v=\"NaN\"/>";
    assert_eq!(without_typefaces(svg), "<a u=\"1\"/>url(data:font/woff2;) <b v=\"NaN\"/>");
}

fn around(text: &str, word: &str) -> String {
    let at = text.to_lowercase().find(word).unwrap_or(0);
    let from = (0..=at.saturating_sub(60)).rev().find(|&i| text.is_char_boundary(i)).unwrap_or(0);
    text[from..].chars().take(140).collect()
}

fn finite(answer: &Answer) -> bool {
    match answer {
        Answer::Scalar { value, bound } => value.is_finite() && bound.is_finite() && *bound >= 0.0,
        Answer::Vector { value, bound } => {
            value.iter().chain([bound]).all(|v| v.is_finite()) && *bound >= 0.0
        }
        Answer::AtInfinity { direction, bound } => direction.iter().chain([bound]).all(|v| v.is_finite()),
        Answer::Indeterminate(_) => true,
    }
}

fn agree(scene: &Scene, solved: &Solved) -> bool {
    let state = solve::solve_analytically(scene);
    let Agreement { compared, elsewhere, lines, refused, power: _ } = check::agreement(scene, solved, &state);
    assert!(elsewhere.is_none(), "DISAGREE: another assembly, seen at {elsewhere:?}");
    assert!(lines.is_empty(), "DISAGREE: lines of forces: {lines:?}");
    for c in &compared {
        assert!(finite(&c.graphical.answer), "{}: {:?}", c.asked.name, c.graphical.answer);
        assert!(finite(&c.analytic), "{}: {:?}", c.asked.name, c.analytic);
        let apart = c.difference.is_some_and(|d| d.ratio.is_nan() || d.ratio > 1.0);
        assert!(!apart, "DISAGREE: {}: {:?} against {:?}", c.asked.name, c.graphical.answer, c.analytic);
    }
    refused.is_none()
}

fn try_scene(dice: &mut Dice, text: &str, tally: &mut Tally) {
    let scene = match scene::read(text, "m.json") {
        Ok(scene) => scene,
        Err(error) => {
            assert!(error.line >= 1 && error.column >= 1 && !error.what.is_empty(), "{error}");
            return;
        }
    };
    tally.scenes += 1;
    let arithmetic = match dice.below(8) {
        0 => Arithmetic::Single,
        1 => Arithmetic::DoubleDouble,
        _ => Arithmetic::Double,
    };
    let settings = Settings { arithmetic, ..Settings::default() };
    let solved = solve::solve_with(&scene, Extent::Asked, &[], settings, sheet::scale::for_scene);
    match &solved {
        Ok(solved) => {
            tally.solved += 1;
            tally.both_answered += u64::from(agree(&scene, solved));
            if dice.below(16) == 0 {
                let hand = GradeSettings::default().hand;
                let by_hand = solve::by_hand(&scene, solved, Draughtsmen { hand, number: 16 });
                numbers_that_are_none("by_hand", &format!("{by_hand:?}"), text);
            }
        }
        Err(error) => {
            let told = linkgram::report::diagnose(&scene, error).to_string();
            numbers_that_are_none("a refusal", &told, text);
            // The other solver refuses or answers; it does neither by a panic.
            let _ = solve::solve_analytically(&scene);
        }
    }
    match dice.below(8) {
        0 | 1 => try_figure(dice, &scene, text, settings, tally),
        2 => try_sweep(&scene, text, dice, tally),
        3 => {
            let report = linkgram::mechanism::report::report(&scene.mechanism, &|_| None);
            numbers_that_are_none("structure", &format!("{report:?}"), text);
        }
        4 => drop(check::check_with(&scene, 0.05, settings)),
        _ => {}
    }
}

fn try_figure(dice: &mut Dice, scene: &Scene, text: &str, settings: Settings, tally: &mut Tally) {
    let languages = [None, Some(Language::English), Some(Language::Arabic), Some(Language::Persian)];
    let names = [
        "skeleton",
        "velocity",
        "acceleration",
        "centres",
        "circle",
        "transfer",
        "results",
        "steps",
        "klein",
    ];
    let figures = if dice.below(3) == 0 { vec![(*dice.pick(&names)).to_owned()] } else { Vec::new() };
    let kind = if figures.is_empty() { *dice.pick(&Kind::ALL) } else { Kind::Solution };
    let wish = Wish { kind, figures, language: *dice.pick(&languages), settings };
    match drawing::figure(scene, &wish) {
        Ok(figure) => {
            tally.figures += 1;
            for format in [render::Format::Svg, render::Format::Json] {
                let bytes = render::render(&figure, format, &render::Options::default()).unwrap();
                let told = String::from_utf8(bytes).unwrap();
                numbers_that_are_none(format.name(), &without_typefaces(&told), text);
                if format == render::Format::Svg {
                    let read = roxmltree::Document::parse(&told).err();
                    assert!(read.is_none(), "an SVG that is no XML: {read:?}");
                }
            }
        }
        Err(error) => numbers_that_are_none("a refusal", &error.told(scene), text),
    }
}

fn try_sweep(scene: &Scene, text: &str, dice: &mut Dice, tally: &mut Tally) {
    let over = if dice.below(4) == 0 { Over::Time } else { Over::Input };
    match Sweep::over(over, &scene.mechanism, None) {
        Ok(sweep) => {
            tally.sweeps += 1;
            for position in sweep.positions(&sweep.equal_steps(24)) {
                let fine = position.at.is_finite() && position.values.iter().flatten().all(|v| v.is_finite());
                assert!(fine, "a sweep has {position:?}");
            }
            numbers_that_are_none("strokes", &format!("{:?}", sweep.strokes()), text);
        }
        Err(error) => numbers_that_are_none("a refusal", &error.to_string(), text),
    }
}

fn try_answers(dice: &mut Dice, scene_text: &str, tally: &mut Tally) -> String {
    let Ok(scene) = scene::read(scene_text, "s.json") else { return String::new() };
    let text = if dice.below(3) == 0 {
        mutation::drawing(dice, scene_text)
    } else {
        mutation::answers(dice, scene_text)
    };
    trying(&format!("{scene_text}\n---\n{text}"));
    let Ok(answers) = grade::read_named(&text, "a", &scene) else { return text };
    let settings = GradeSettings { draughtsmen: 8, ..GradeSettings::default() };
    if let Ok((report, figure)) = grade::grade_with_overlay(&scene, &answers, &settings) {
        tally.graded += 1;
        numbers_that_are_none("a report", &report.to_text(), &text);
        let json = report.to_json().to_string();
        numbers_that_are_none("a report", &json, &text);
        if let Some(figure) = figure {
            numbers_that_are_none("an overlay", &render::svg::write(&figure), &text);
        }
    }
    text
}

thread_local! {
    /// What is being tried here.
    static INPUT: RefCell<String> = const { RefCell::new(String::new()) };
    /// What the last panic here said.
    static SAID: RefCell<String> = const { RefCell::new(String::new()) };
    /// Whether panics here are caught and told by the fuzzer.
    static QUIET: RefCell<bool> = const { RefCell::new(false) };
}

/// Panics of inputs are told once, with the input; all others as ever.
fn listen() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        let usual = std::panic::take_hook();
        std::panic::set_hook(Box::new(move |info| {
            if QUIET.with_borrow(|quiet| *quiet) {
                SAID.with_borrow_mut(|said| *said = info.to_string());
            } else {
                usual(info);
            }
        }));
    });
}

/// Tries something of every room.
pub(crate) fn every_room(seeds: &[String]) -> impl Fn(&mut Dice, &mut Tally) {
    |dice, tally| {
        let from = dice.pick(seeds).clone();
        if dice.below(5) == 0 {
            try_answers(dice, &from, tally);
        } else {
            let text = mutation::scene(dice, &from);
            trying(&text);
            try_scene(dice, &text, tally);
        }
    }
}

/// What was tried last by whichever thread, to be told if it does not end.
static LAST: Mutex<String> = Mutex::new(String::new());

/// Notes what is being tried, to be told if it fails.
pub(crate) fn trying(text: &str) {
    INPUT.with_borrow_mut(|input| text.clone_into(input));
    text.clone_into(&mut LAST.lock().unwrap());
}

/// Tries one input; what failed.
fn one(
    seed: u64,
    index: u64,
    attempt: &dyn Fn(&mut Dice, &mut Tally),
    tally: &mut Tally,
) -> Result<(), (String, String)> {
    let mut dice = Dice(seed.wrapping_mul(0x2545_f491_4f6c_dd1d) ^ index.wrapping_mul(0x9e6c_63d0_676a_9a99));
    QUIET.with_borrow_mut(|quiet| *quiet = true);
    let tried = catch_unwind(AssertUnwindSafe(|| attempt(&mut dice, tally)));
    QUIET.with_borrow_mut(|quiet| *quiet = false);
    tried.map_err(|_| (SAID.with_borrow(Clone::clone), INPUT.with_borrow(Clone::clone)))
}

/// What is being tried, since when: whoever hangs is named.
type Now = Arc<Mutex<Option<(Instant, u64)>>>;

fn watch(now: &Now, longest: Duration) {
    let now = Arc::downgrade(now);
    std::thread::spawn(move || {
        while let Some(now) = now.upgrade() {
            if let Some((since, index)) = *now.lock().unwrap()
                && since.elapsed() > 100 * longest
            {
                eprintln!("input {index} does not end:\n{}", LAST.lock().unwrap());
                std::process::exit(101);
            }
            drop(now);
            std::thread::sleep(Duration::from_millis(500));
        }
    });
}

/// Tries so many inputs; what became of them, and what failed.
pub(crate) fn run(
    (count, seed): (u64, u64),
    longest: Duration,
    keep: Option<&PathBuf>,
    attempt: &dyn Fn(&mut Dice, &mut Tally),
) -> (Tally, Vec<String>) {
    listen();
    let (mut tally, mut failures) = (Tally::default(), Vec::new());
    let now: Now = Arc::new(Mutex::new(None));
    watch(&now, longest);
    let first = number("LINKGRAM_FUZZ_FIRST", 0);
    for index in first..first + count {
        let begun = Clock::start();
        *now.lock().unwrap() = Some((Instant::now(), index));
        let result = one(seed, index, attempt, &mut tally);
        let took = begun.elapsed();
        tally.inputs += 1;
        tally.slowest_ms = tally.slowest_ms.max(took.as_millis());
        let failed = match result {
            Err(failed) => Some(failed),
            Ok(()) if took > longest => Some((format!("took {took:?}"), INPUT.with_borrow(Clone::clone))),
            Ok(()) => None,
        };
        if let Some((what, input)) = failed {
            if let Some(folder) = keep {
                std::fs::write(folder.join(format!("{seed}-{index}.txt")), format!("{what}\n===\n{input}\n"))
                    .unwrap();
            }
            let input: String = input.chars().take(3_000).collect();
            failures.push(format!("input {index} of seed {seed}: {what}\n{input}"));
        }
        if count > 100_000 && index % 50_000 == 0 {
            eprintln!("{tally:?}, {} failures", failures.len());
        }
    }
    *now.lock().unwrap() = None;
    (tally, failures)
}

#[test]
fn a_sample_of_the_fuzzer() {
    let (tally, failures) = run((SAMPLE, 1), PATIENT, None, &every_room(&seeds()));
    assert!(failures.is_empty(), "{} failures, the first: {}", failures.len(), failures[0]);
    // The mutations reach every room.
    let reached =
        [tally.scenes, tally.solved, tally.both_answered, tally.figures, tally.sweeps, tally.graded];
    assert!(reached.iter().all(|count| *count > SAMPLE / 100), "{tally:?}");
}

/// The peak of this process, where the system tells it (KiB).
fn peak() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
    line.trim().trim_end_matches("kB").trim().parse().ok()
}

/// What the environment says under a name, where it does.
fn number(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// As many inputs as one wishes: `LINKGRAM_FUZZ` of them, from `LINKGRAM_FUZZ_FIRST` on.
pub(crate) fn campaign_of(attempt: &dyn Fn(&mut Dice, &mut Tally)) {
    let from = (number("LINKGRAM_FUZZ", 100_000), number("LINKGRAM_FUZZ_SEED", 2));
    let keep = std::env::var_os("LINKGRAM_FUZZ_KEEP").map(PathBuf::from);
    let (tally, failures) = run(from, TWO_SECONDS, keep.as_ref(), attempt);
    eprintln!("{tally:?}, peak {:?} KiB", peak());
    let told: Vec<&str> = failures.iter().map(String::as_str).take(5).collect();
    assert!(failures.is_empty(), "{} failures:\n{}", failures.len(), told.join("\n\n"));
    assert!(peak().is_none_or(|peak| peak <= MEMORY), "more memory than {} MiB", MEMORY >> 10);
}

#[test]
#[ignore = "a campaign: as long as one wishes"]
fn campaign() {
    campaign_of(&every_room(&seeds()));
}
