//! The sheets of all examples against the blessed ones in `golden/`: SVG byte for byte, pixels within a
//! small tolerance.
//!
//! `LINKGRAM_BLESS=1 cargo test --test goldens` makes the present sheets the golden ones. Look at the
//! pictures before you commit them, and commit a bless on its own. A failure writes
//! `target/golden-report/report.html`: expected, actual and difference side by side.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

#[cfg(feature = "png")]
mod pixels;
mod report;
#[path = "../sheets/mod.rs"]
mod sheets;

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::process::Command;

use linkgram::sheet::Language;
use report::Mismatch;
use sheets::{Example, Kind, examples, root};

/// The pictures in the README: first pages.
const TITLES: [&str; 4] = ["title-page", "title-page-ar", "question-page", "question-page-ar"];

fn golden(name: &str, extension: &str) -> PathBuf {
    root().join("golden").join(format!("{name}.{extension}"))
}

fn blessing() -> bool {
    std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1")
}

/// Every kind of the catalogue as it comes.
fn catalogue() -> Vec<Example> {
    let folder = root().join("src/catalogue");
    let of = |kind: &linkgram::catalogue::Kind| Example {
        name: format!("catalogue.{}", kind.name),
        path: folder.join(format!("{}.json", kind.name)),
        kind: Kind::Solution,
        language: Language::English,
    };
    linkgram::catalogue::KINDS.iter().map(of).collect()
}

/// The same scenes in other languages, as questions and step by step: some of each.
fn variants() -> Vec<Example> {
    use Kind::{Question, Solution, Steps};
    use Language::{Arabic, ArabicAjala, English, Persian};
    let of = [
        ("s000-ch3a-1", Question, English),
        ("s000-ch3a-1", Question, Arabic),
        ("s000-ch3a-1", Question, ArabicAjala),
        ("s000-ch3a-1", Question, Persian),
        ("s000-ch3a-1", Solution, Arabic),
        ("s000-ch3a-1", Solution, ArabicAjala),
        ("s000-ch3a-1", Solution, Persian),
        ("s000-ch3a-1", Steps, English),
        ("s000-ch3a-2", Question, English),
        ("s000-ch3a-2", Solution, Arabic),
        ("s000-ch3a-2", Steps, Persian),
        ("s000-ch4-1", Question, Arabic),
        ("s000-ch4-9-b", Question, English),
        ("s000-ch4-9-b", Solution, Persian),
    ];
    let variant = |(name, kind, language): (&str, Kind, Language)| {
        let kind_name = match kind {
            Solution => "solution",
            Question => "question",
            Steps => "steps",
        };
        let tag = match language {
            English => "en",
            Arabic => "ar",
            ArabicAjala => "ar-x-ajala",
            Persian => "fa",
        };
        let path = root().join(format!("examples/{name}.json"));
        Example { name: format!("{name}.{kind_name}.{tag}"), path, kind, language }
    };
    of.into_iter().map(variant).collect()
}

#[test]
fn every_sheet_is_its_golden() {
    let mut examples = examples();
    examples.extend(variants());
    examples.extend(catalogue());
    if blessing() {
        bless(&examples);
        return;
    }
    let mut mismatches: Vec<Mismatch> = in_parallel(&examples, compare).into_iter().flatten().collect();
    #[cfg(feature = "png")]
    mismatches.extend(pixels::compare_title_pages());
    for stale in strangers(&examples) {
        mismatches.push(Mismatch::missing(&stale, "no example belongs to this golden file"));
    }
    if mismatches.is_empty() {
        return;
    }
    let path = report::write(&mismatches);
    let names: Vec<String> = mismatches.iter().map(|m| format!("  {}: {}", m.name, m.why)).collect();
    panic!(
        "{} sheets differ from their golden:\n{}\nlook at {}\nif the new ones are right: LINKGRAM_BLESS=1 cargo test --test goldens",
        mismatches.len(),
        names.join("\n"),
        path.display()
    );
}

/// One sheet against its golden files.
fn compare(example: &Example) -> Option<Mismatch> {
    let (_, _, actual) = sheets::draw(example);
    let Ok(expected) = std::fs::read_to_string(golden(&example.name, "svg")) else {
        return Some(Mismatch::new(&example.name, "there is no golden SVG", None, &actual));
    };
    if expected != actual {
        let line = expected.lines().zip(actual.lines()).take_while(|(e, a)| e == a).count() + 1;
        let why = format!("the SVG differs from line {line} on");
        return Some(Mismatch::new(&example.name, &why, Some(&expected), &actual));
    }
    #[cfg(feature = "png")]
    if let Some(mismatch) = pixels::compare(&example.name, &actual) {
        return Some(mismatch);
    }
    None
}

fn bless(examples: &[Example]) {
    for stranger in strangers(examples) {
        std::fs::remove_file(root().join("golden").join(&stranger)).unwrap();
        println!("removed golden/{stranger}");
    }
    for changed in in_parallel(examples, bless_one).into_iter().flatten() {
        println!("blessed {changed}");
    }
    #[cfg(feature = "png")]
    pixels::bless_title_pages();
    println!("now look at the pictures, and commit them on their own");
}

fn bless_one(example: &Example) -> Option<String> {
    let (_, _, svg) = sheets::draw(example);
    let path = golden(&example.name, "svg");
    let changed = std::fs::read_to_string(&path).ok().is_none_or(|old| old != svg);
    if changed {
        std::fs::write(&path, &svg).unwrap();
    }
    #[cfg(feature = "png")]
    pixels::bless(&example.name, &svg);
    changed.then(|| example.name.clone())
}

/// Sheets in `golden/` that belong to no example.
fn strangers(examples: &[Example]) -> Vec<String> {
    let known: BTreeSet<String> = examples
        .iter()
        .flat_map(|e| [format!("{}.svg", e.name), format!("{}.png", e.name)])
        .chain(TITLES.iter().map(|name| format!("{name}.png")))
        .collect();
    let mut strangers: Vec<String> = std::fs::read_dir(root().join("golden"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".svg") || name.ends_with(".png"))
        .filter(|name| !known.contains(name))
        .collect();
    strangers.sort();
    strangers
}

/// `work` on every example, on all processors; the results in the order of the examples.
fn in_parallel<T: Send>(examples: &[Example], work: impl Fn(&Example) -> T + Sync) -> Vec<T> {
    let workers = std::thread::available_parallelism().map_or(1, usize::from);
    let next = std::sync::atomic::AtomicUsize::new(0);
    let done = std::sync::Mutex::new(Vec::new());
    std::thread::scope(|scope| {
        for _ in 0..workers {
            scope.spawn(|| {
                loop {
                    let index = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(example) = examples.get(index) else { break };
                    let result = work(example);
                    done.lock().unwrap().push((index, result));
                }
            });
        }
    });
    let mut done = done.into_inner().unwrap();
    done.sort_by_key(|(index, _)| *index);
    done.into_iter().map(|(_, result)| result).collect()
}

/// Two processes have two seeds of every hash map and two layouts of memory; their bytes are the same.
#[test]
fn two_runs_give_the_same_bytes() {
    let run = |arguments: &[&str]| {
        let output = Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).output().unwrap();
        assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
        output.stdout
    };
    for example in examples() {
        let path = example.path.to_str().unwrap();
        for arguments in [&["draw", path][..], &["solve", path, "--json", "--explain"]] {
            assert!(run(arguments) == run(arguments), "{}: {} differs", example.name, arguments[0]);
        }
    }
}

#[test]
fn the_command_draws_the_golden_sheet() {
    if blessing() {
        return;
    }
    let example = root().join("examples/s000-ch3a-1.json");
    let output = Command::new(env!("CARGO_BIN_EXE_linkgram")).arg("draw").arg(example).output().unwrap();
    assert!(output.status.success());
    assert!(output.stdout == std::fs::read(golden("s000-ch3a-1", "svg")).unwrap());
}
