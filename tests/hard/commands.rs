//! Whole commands, with files that nobody means and options at random: each ends with 0, 1 or 2, says why where it is not
//! 0, and leaves no half of a file.
//!
//! The sample of every `cargo test` runs the program; a campaign runs the same commands inside one process, thousands of
//! times quicker, with its standard output led away: `cargo test --release --test all hard::commands::campaign --
//! --ignored --nocapture >/dev/null`.

use std::ffi::OsString;
use std::process::{Command, ExitCode};

use super::dice::Dice;
use super::folder::Folder;
use super::fuzz::{self, Tally, campaign_of, numbers_that_are_none, trying};
use super::mutation;

/// How many commands every `cargo test` runs.
const SAMPLE: u64 = 120;

const LANGUAGES: &[&str] = &["en", "ar", "fa", "ar-sy", "tlh", ""];
const PLACES: &[&str] = &["0", "1", "-1", "90", "400", "1e9", "nan", "-inf", ""];

/// An option that is there, every other time.
fn maybe(dice: &mut Dice, into: &mut Vec<String>, option: &[&str]) {
    if dice.below(4) == 0 {
        into.extend(option.iter().map(|&word| word.to_owned()));
    }
}

/// The words after the program's name, for the files that stand in the folder.
fn words(dice: &mut Dice, here: &dyn Fn(&str) -> String) -> Vec<String> {
    let scene = here("s.json");
    let own = |words: &[&str]| words.iter().map(|&word| word.to_owned()).collect::<Vec<_>>();
    let arith = *dice.pick(&["f32", "f64", "dd"]);
    let lang = *dice.pick(LANGUAGES);
    let output = |dice: &mut Dice, into: &mut Vec<String>, endings: &[&str]| {
        let ending = *dice.pick(endings);
        into.extend(["-o".to_owned(), here(&format!("out.{ending}"))]);
    };
    match dice.below(24) {
        0..=7 => {
            let mut all = own(&["draw", &scene]);
            output(dice, &mut all, &["svg", "json", "tex", "svg", "odd"]);
            let kind = *dice.pick(&["solution", "question", "steps"]);
            maybe(dice, &mut all, &["--as", kind]);
            maybe(dice, &mut all, &["--play"]);
            let figure = *dice.pick(&["skeleton", "velocity", "circle", "centrodes(1,3)", "klein", "x"]);
            maybe(dice, &mut all, &["--figure", figure]);
            let paper = *dice.pick(&["A4", "A3 landscape", "A5", "1x1mm", "A0"]);
            maybe(dice, &mut all, &["--paper", paper]);
            maybe(dice, &mut all, &["--lang", lang]);
            maybe(dice, &mut all, &["--arith", arith]);
            maybe(dice, &mut all, &["--other-assembly"]);
            maybe(dice, &mut all, &["--unchecked"]);
            let positions = format!("{},{}", dice.pick(PLACES), dice.pick(PLACES));
            maybe(dice, &mut all, &["--positions", &positions]);
            all
        }
        8..=11 => {
            let mut all = own(&["solve", &scene, "--arith", arith]);
            maybe(dice, &mut all, &["--json"]);
            maybe(dice, &mut all, &["--explain"]);
            maybe(dice, &mut all, &["--hand", "0.2mm,0.3deg"]);
            all
        }
        12 => own(&["check", &here(""), "--tolerance", *dice.pick(&["5%", "0", "101%"])]),
        13 | 14 => {
            let file: &&str = dice.pick(&["a.json", "a.csv", "d.svg"]);
            let answers = here(file);
            let mut all = own(&["grade", &scene, &answers]);
            maybe(dice, &mut all, &["--json"]);
            if dice.below(3) == 0 {
                output(dice, &mut all, &["html", "svg", "json"]);
            }
            all
        }
        15 => own(&["structure", &scene, "--json"]),
        16..=19 => {
            let mut all = own(&["sweep", &scene]);
            let steps = *dice.pick(&["1", "7", "90", "0", "10000001"]);
            maybe(dice, &mut all, &["--steps", steps]);
            let straying = *dice.pick(&["1%", "0.1%", "0"]);
            maybe(dice, &mut all, &["--tolerance", straying]);
            maybe(dice, &mut all, &["--bounds"]);
            maybe(dice, &mut all, &["--against", "time"]);
            let (from, to) = (*dice.pick(PLACES), *dice.pick(PLACES));
            maybe(dice, &mut all, &["--from", from, "--to", to]);
            maybe(dice, &mut all, &["--only", "v(B)"]);
            output(dice, &mut all, &["csv", "json", "svg", "tex"]);
            all
        }
        20 => own(&[
            "exam",
            &scene,
            "--variants",
            *dice.pick(&["1", "2", "0"]),
            "-o",
            &here("exam"),
            "--jobs",
            "1",
        ]),
        21 => own(&["golden", *dice.pick(&["check", "bless"]), &here("suite")]),
        22 => own(&["tradeoff", &scene, "--passes", "1"]),
        _ => own(&["new", *dice.pick(&["four-bar", "", "\u{1b}[2J", "slider-crank"])]),
    }
}

/// The files of one run; what they hold, to be told if it fails.
fn files(dice: &mut Dice, seeds: &[String], folder: &Folder) -> String {
    let from = dice.pick(seeds).clone();
    // Every other one as it stands: what comes after the reading is tried too.
    let scene = if dice.below(2) == 0 { from.clone() } else { mutation::scene(dice, &from) };
    let answers = mutation::answers(dice, &from);
    let drawing = mutation::drawing(dice, &from);
    folder.write("s.json", &scene);
    folder.write("a.json", &answers);
    folder.write("a.csv", &answers);
    folder.write("d.svg", &drawing);
    std::fs::create_dir_all(folder.path("suite")).unwrap();
    folder.write("suite/s.json", &scene);
    format!("{scene}\n---\n{answers}\n---\n{drawing}")
}

/// Nothing of a run is left but what it was to write.
fn nothing_half(folder: &Folder) {
    let left: Vec<String> = folder.names().into_iter().filter(|name| name.contains(".part")).collect();
    assert!(left.is_empty(), "left behind: {left:?}");
}

#[test]
fn a_sample_of_commands() {
    let seeds = fuzz::seeds();
    let folder = Folder::new("commands");
    let attempt = |dice: &mut Dice, tally: &mut Tally| {
        let told = files(dice, &seeds, &folder);
        let words = words(dice, &|name| folder.path(name).to_string_lossy().into_owned());
        trying(&format!("{words:?}\n{told}"));
        let ran = folder.run_by(Command::new(env!("CARGO_BIN_EXE_linkgram")).args(&words));
        let Some(code @ 0..=2) = ran.code else { panic!("{words:?} ends with {:?}: {}", ran.code, ran.err) };
        tally.ended[usize::try_from(code).unwrap()] += 1;
        assert!(code != 2 || ran.err.contains("error: "), "{words:?} says nothing: {}", ran.err);
        let input = format!("{words:?} {told}");
        numbers_that_are_none("a command", &ran.out, &input);
        numbers_that_are_none("a command", &ran.err, &input);
        nothing_half(&folder);
    };
    let (tally, failures) = fuzz::run((SAMPLE, 5), fuzz::PATIENT, None, &attempt);
    assert!(failures.is_empty(), "{} failures, the first: {}", failures.len(), failures[0]);
    assert!(tally.ended[0] > 20 && tally.ended[2] > 10, "{tally:?}");
}

#[test]
#[ignore = "a campaign: as long as one wishes"]
fn campaign() {
    let seeds = fuzz::seeds();
    let folder = Folder::new("command-campaign");
    campaign_of(&|dice, tally| {
        let told = files(dice, &seeds, &folder);
        let words = words(dice, &|name| folder.path(name).to_string_lossy().into_owned());
        trying(&format!("{words:?}\n{told}"));
        let all = std::iter::once("linkgram".to_owned()).chain(words.iter().cloned()).map(OsString::from);
        let code = linkgram::cli::run_with(all);
        let status = [0, 1, 2].into_iter().find(|status| code == ExitCode::from(*status));
        let Some(status) = status else { panic!("{words:?} ends with {code:?}") };
        tally.ended[usize::from(status)] += 1;
        nothing_half(&folder);
    });
}
