//! Ten thousand broken scenes: each is solved, or refused with a place and a reason. Never a panic, never a
//! not-a-number or an infinity in an answer, and never long.
//!
//! The scenes are the examples with one to three mutations each, from a fixed seed, so that every run sees
//! the same ones.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::time::{Duration, Instant};

use linkgram::check;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::{self, Scene};
use linkgram::solve::{self, SolveError};
use linkgram::{analytic, sheet};
use serde_json::Value;

/// In all; shared out among the tests below so that they run side by side.
const FILES: usize = 10_000;
const SHARES: usize = 4;

/// The longest that one file may take, on a busy machine and hardly optimised.
const LONGEST: Duration = Duration::from_secs(10);

/// Splitmix64: small, and the same everywhere.
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    fn below(&mut self, count: usize) -> usize {
        usize::try_from(self.next() % u64::try_from(count.max(1)).unwrap()).unwrap()
    }

    fn pick<'a, T>(&mut self, from: &'a [T]) -> &'a T {
        &from[self.below(from.len())]
    }
}

/// Numbers that nobody means. The last ones are no JSON numbers.
const ABSURD: &[&str] = &[
    "1e308",
    "-1e308",
    "1.7976931348623157e308",
    "-0",
    "-0.0",
    "0",
    "1e-320",
    "5e-324",
    "-1e-320",
    "2.2250738585072014e-308",
    "1e-9",
    "1e9",
    "1e15",
    "1e16",
    "-1",
    "0.1",
    "123456789012345678901234567890",
    "1e400",
    "-1e999",
    "1e-999",
    "3",
    "360",
    "-3600000",
    "9007199254740993",
    "1e154",
    "1e-154",
    "NaN",
    "Infinity",
    "-Infinity",
    "0x10",
    "1e",
    "--1",
    "+1",
    "01",
    ".5",
    "null",
];

/// Strings where a number, a quantity or a name stands.
const WORDS: &[&str] = &[
    "",
    " ",
    "A",
    "O2",
    "Z9",
    "1",
    "1e308 km",
    "1e-320 nm",
    "-0 rad",
    "1e400 mm",
    "10 rad/s cw ccw",
    "30 deg",
    "5 parsec",
    "rad/s",
    "nan",
    "inf",
    "1 mm",
    "v(A)",
    "v(A/B)",
    "omega(99)",
    "omega(1)",
    "alpha(2/2)",
    "rub(B)",
    "rub(A,1/2)",
    "I(1,1)",
    "I(2,3)",
    "slip(A/2)",
    "v(A@2)",
    "coriolis(D/1)",
    "x(O2)",
    "angle(1)",
    "transmission(2/2)",
    "v(",
    "(((((",
    "\u{202e}\u{0}",
    "ω(3)",
    "متر",
    "cannot-assemble",
    "indeterminate",
    "ambiguous",
    "A4",
    "1:0",
    "1:1e308",
    "0 cm/s per cm",
    "ccw",
    "cw",
    "toward",
    "\\",
    "\"",
];

/// Keys of the format and strangers.
const KEYS: &[&str] = &[
    "title",
    "units",
    "fixed",
    "placed",
    "near",
    "links",
    "slides",
    "rolls",
    "input",
    "inputs",
    "find",
    "pins",
    "published",
    "errata",
    "expect",
    "sheet",
    "joins",
    "length",
    "line",
    "sides",
    "turn",
    "shape",
    "arms",
    "pin",
    "block",
    "link",
    "on",
    "through",
    "angle",
    "toward",
    "turned",
    "offset",
    "centre",
    "radius",
    "omega",
    "alpha",
    "speed",
    "slide",
    "at",
    "velocity",
    "name",
    "unit",
    "value",
    "within",
    "A",
    "B",
    "C",
    "D",
    "O2",
    "O4",
    "1",
    "2",
    "3",
    "99",
    "-1",
    "4294967296",
    "",
    "lenght",
    "colour",
];

/// One mutation of the bytes.
fn bend_text(dice: &mut Dice, text: &str) -> String {
    let mut bytes = text.as_bytes().to_vec();
    if bytes.is_empty() {
        return "{".to_owned();
    }
    let at = dice.below(bytes.len());
    match dice.below(8) {
        0 => bytes.truncate(at),
        1 => drop(bytes.drain(at..(at + 1 + dice.below(40)).min(bytes.len()))),
        2 => {
            let piece = bytes[at..(at + 1 + dice.below(80)).min(bytes.len())].to_vec();
            let to = dice.below(bytes.len());
            bytes.splice(to..to, piece);
        }
        3 => bytes[at] = b"0123456789eE-.,:[]{}\"/ ABO\n"[dice.below(27)],
        4 => bytes[at] = u8::try_from(dice.below(256)).unwrap(),
        5 => {
            let other = dice.below(bytes.len());
            bytes.swap(at, other);
        }
        6 => {
            let deep = dice.below(5000);
            let brackets = dice.pick(&["[", "{\"a\":", "\"", "]"]).repeat(deep);
            bytes.splice(at..at, brackets.bytes());
        }
        _ => return bend_number(dice, text),
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

/// Puts an absurd number in the place of one that stands there.
fn bend_number(dice: &mut Dice, text: &str) -> String {
    let bytes = text.as_bytes();
    let starts: Vec<usize> = (1..bytes.len())
        .filter(|&i| bytes[i].is_ascii_digit() && b" [:-\"".contains(&bytes[i - 1]))
        .collect();
    if starts.is_empty() {
        return text.to_owned();
    }
    let start = *dice.pick(&starts);
    let end = (start..bytes.len()).find(|&i| !b"0123456789.eE+-".contains(&bytes[i])).unwrap_or(bytes.len());
    format!("{}{}{}", &text[..start], dice.pick(ABSURD), &text[end..])
}

/// Paths of all values.
fn paths(value: &Value, here: &str, into: &mut Vec<String>) {
    into.push(here.to_owned());
    match value {
        Value::Object(map) => {
            for (key, inner) in map {
                paths(inner, &format!("{here}/{}", key.replace('~', "~0").replace('/', "~1")), into);
            }
        }
        Value::Array(list) => {
            for (index, inner) in list.iter().enumerate() {
                paths(inner, &format!("{here}/{index}"), into);
            }
        }
        _ => {}
    }
}

/// Makes one number larger, smaller, negative or zero, or drops a hint.
fn bend_one_number(dice: &mut Dice, root: &mut Value) {
    const FACTORS: [f64; 14] =
        [-1.0, 0.0, 1e-3, 0.5, 0.9, 1.0 + 1e-9, 1.1, 2.0, 10.0, 1e3, 1e6, 1e-12, 1e300, 1e-300];
    let mut all = Vec::new();
    paths(root, "", &mut all);
    all.retain(|path| root.pointer(path).is_some_and(Value::is_number));
    if all.is_empty() || dice.below(12) == 0 {
        if let Some(near) = root.get_mut("near").and_then(Value::as_object_mut) {
            near.clear();
        }
        return;
    }
    let path = dice.pick(&all).clone();
    if let Some(value) = root.pointer_mut(&path) {
        *value = serde_json::json!(value.as_f64().unwrap() * *dice.pick(&FACTORS));
    }
}

/// One mutation of the structure: the result is JSON, so that the later rooms are reached.
fn bend_value(dice: &mut Dice, root: &mut Value) {
    let mut all = Vec::new();
    paths(root, "", &mut all);
    let path = dice.pick(&all).clone();
    let donor = root.pointer(&dice.pick(&all).clone()).unwrap().clone();
    let huge = dice.below(40) == 0;
    let kind = dice.below(9);
    let Some(value) = root.pointer_mut(&path) else { return };
    match (kind, &mut *value) {
        (0 | 1, Value::Object(map)) if !map.is_empty() => {
            let key = map.keys().nth(dice.below(map.len())).unwrap().clone();
            let inner = map.remove(&key).unwrap();
            if kind == 1 {
                map.insert((*dice.pick(KEYS)).to_owned(), inner);
            }
        }
        (0..=2, Value::Array(list)) if !list.is_empty() => {
            let index = dice.below(list.len());
            match kind {
                0 => drop(list.remove(index)),
                1 => list.push(list[index].clone()),
                _ => {
                    let other = dice.below(list.len());
                    list.swap(index, other);
                }
            }
        }
        (4 | 5, _) => *value = donor,
        (6, _) => {
            let word = (*dice.pick(WORDS)).to_owned();
            *value = Value::String(if huge { format!("{word}x").repeat(20_000) } else { word });
        }
        (7, _) => {
            *value = serde_json::from_str(dice.pick::<&str>(ABSURD)).unwrap_or(Value::Bool(true));
        }
        (_, Value::Object(map)) => {
            map.insert((*dice.pick(KEYS)).to_owned(), donor);
        }
        (_, other) => *other = serde_json::json!([[], {}, null]).get(dice.below(3)).unwrap().clone(),
    }
}

fn mutated(dice: &mut Dice, example: &str) -> String {
    let mut text = example.to_owned();
    // Half of the files keep their words, so that most of these reach the solvers.
    let gentle = dice.below(2) == 0;
    for _ in 0..=dice.below(3) {
        if gentle {
            match serde_json::from_str::<Value>(&text) {
                Ok(mut value) if dice.below(4) > 0 => {
                    bend_one_number(dice, &mut value);
                    text = value.to_string();
                }
                _ => text = bend_number(dice, &text),
            }
            continue;
        }
        if dice.below(2) == 0 {
            text = bend_text(dice, &text);
        } else if let Ok(mut value) = serde_json::from_str::<Value>(&text) {
            bend_value(dice, &mut value);
            // A number beyond a double, or spaces as people write them.
            text = if dice.below(4) == 0 {
                value.to_string()
            } else {
                serde_json::to_string_pretty(&value).unwrap()
            };
            if dice.below(3) == 0 {
                text = bend_number(dice, &text);
            }
        }
    }
    text
}

fn finite(answer: &Answer) -> bool {
    match answer {
        Answer::Scalar { value, bound } => value.is_finite() && bound.is_finite() && *bound >= 0.0,
        Answer::Vector { value, bound } => {
            value.iter().all(|v| v.is_finite()) && bound.is_finite() && *bound >= 0.0
        }
        Answer::AtInfinity { direction, bound } => {
            direction.iter().all(|v| v.is_finite()) && bound.is_finite()
        }
        Answer::Indeterminate(_) => true,
    }
}

/// A message has words, and no number that is none; what it quotes from the file is the file's.
fn says_something(message: &str) {
    assert!(!message.trim().is_empty());
    let own = message.split('`').step_by(2);
    for word in own.flat_map(|part| part.split(|c: char| !c.is_alphanumeric())) {
        assert!(!["nan", "inf", "infinity"].contains(&word.to_lowercase().as_str()), "{message}");
    }
}

/// What became of a file.
#[derive(Debug, Default, Clone, Copy)]
struct Tally {
    unreadable: usize,
    refused: usize,
    indeterminate: usize,
    solved: usize,
    one_refuses: usize,
}

fn judge(text: &str, scene: &Scene, tally: &mut Tally, with_sheet: bool) {
    let solved = match solve::solve(scene, Extent::Asked, sheet::scale::for_scene) {
        Ok(solved) => solved,
        Err(error) => {
            says_something(&error.to_string());
            match error {
                SolveError::Indeterminate { .. } => tally.indeterminate += 1,
                _ => tally.refused += 1,
            }
            // The other solver refuses or answers, and does neither by a panic.
            let _ = solve::solve_analytically(scene);
            return;
        }
    };
    for reading in &solved.solution.construction.answers {
        assert!(finite(&reading.answer), "{:?}", reading.answer);
        assert!(reading.drawn_mm.is_none_or(f64::is_finite));
    }
    let state = solve::solve_analytically(scene);
    if let Ok(state) = &state {
        for asked in &scene.mechanism.asked {
            let answer = state.answer(&asked.quantity);
            assert!(finite(&answer), "analytic {}: {answer:?}", asked.name);
        }
    }
    let agreement = check::agreement(scene, &solved, &state);
    tally.solved += 1;
    // One solver may refuse where the other still answers, at the edge of what can be told apart; two
    // places or two numbers that contradict each other are wrong.
    assert!(agreement.elsewhere.is_none(), "wrong branch at {:?}", agreement.elsewhere);
    for c in &agreement.compared {
        let apart = c.difference.is_some_and(|d| d.ratio > 1.0);
        assert!(!apart, "{}: {:?} against {:?}", c.asked.name, c.graphical.answer, c.analytic);
    }
    assert!(agreement.ok() || agreement.refused.is_some(), "no agreement and no reason");
    tally.one_refuses += usize::from(!agreement.ok());
    if with_sheet {
        let whole = solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene);
        if let (Ok(whole), Some(language)) = (whole, sheet::Language::from_tag("en")) {
            let figure = sheet::solution(scene, &whole.solution.construction, language);
            let svg = linkgram::render::svg::write(&figure);
            let quoted = text.to_lowercase();
            let svg = svg.to_lowercase();
            for word in ["nan", "inf"] {
                // As a word of its own: "at infinity" is a place.
                let own =
                    svg.split(|c: char| !c.is_alphabetic()).any(|w| w == word) && !quoted.contains(word);
                assert!(!own, "the sheet has a number that is none");
            }
        }
    }
}

fn run(share: usize) -> Tally {
    let examples: Vec<String> =
        common::example_paths().iter().map(|p| std::fs::read_to_string(p).unwrap()).collect();
    let mut tally = Tally::default();
    for index in (share..FILES).step_by(SHARES) {
        let mut dice = Dice(u64::try_from(index).unwrap().wrapping_mul(0x2545_f491_4f6c_dd1d));
        let example = dice.pick(&examples).clone();
        let text = mutated(&mut dice, &example);
        let start = Instant::now();
        let result = std::panic::catch_unwind(|| {
            let mut tally = Tally::default();
            match scene::read(&text, "m.json") {
                Err(error) => {
                    assert!(error.line >= 1 && error.column >= 1, "{error}");
                    assert!(error.line <= text.matches('\n').count() + 1, "{error}");
                    says_something(&error.what);
                    tally.unreadable += 1;
                }
                Ok(scene) => judge(&text, &scene, &mut tally, index % 16 == 0),
            }
            tally
        });
        let took = start.elapsed();
        let shown = || text.chars().take(4000).collect::<String>();
        assert!(took < LONGEST, "file {index} took {took:?}:\n{}", shown());
        let Ok(one) = result else { panic!("file {index} failed:\n{}", shown()) };
        tally.unreadable += one.unreadable;
        tally.refused += one.refused;
        tally.indeterminate += one.indeterminate;
        tally.solved += one.solved;
        tally.one_refuses += one.one_refuses;
    }
    println!("{tally:?}");
    // The mutations reach every room.
    assert!(tally.unreadable > 1000 && tally.refused > 20 && tally.solved > 300, "{tally:?}");
    tally
}

#[test]
fn the_first_quarter_of_ten_thousand_mutated_files() {
    run(0);
}

#[test]
fn the_second_quarter_of_ten_thousand_mutated_files() {
    run(1);
}

#[test]
fn the_third_quarter_of_ten_thousand_mutated_files() {
    run(2);
}

#[test]
fn the_fourth_quarter_of_ten_thousand_mutated_files() {
    run(3);
}

#[test]
fn both_solvers_stand_an_empty_scene() {
    let scene = common::read(
        r#"{ "fixed": { "O": [0, 0] }, "links": { "2": { "joins": ["O", "A"], "length": 1 } }, "input": { "link": 2, "angle": 0 } }"#,
    );
    let mut tally = Tally::default();
    judge("", &scene, &mut tally, true);
    assert_eq!((tally.solved, tally.one_refuses), (1, 0));
    assert!(analytic::solve(&scene.mechanism, linkgram::mechanism::quantity::Order::Position).is_ok());
}
