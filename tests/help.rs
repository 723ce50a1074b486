//! The README and the topics of `linkgram help`: one text for the terminal and for `docs/`, and every example in it is run.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use crate::common;

use std::path::{Path, PathBuf};
use std::process::Command;

use linkgram::scene::{self, names_of_quantities};
use serde_json::Value;

const TOPICS: [&str; 10] =
    ["scene", "quantities", "forces", "formats", "grading", "exams", "sweeps", "live", "golden", "accuracy"];

/// A folder that goes away with the test, with the examples in it.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let path = std::env::temp_dir().join(format!("linkgram-help-{}-{name}", std::process::id()));
        let _ = std::fs::remove_dir_all(&path);
        std::fs::create_dir_all(path.join("lectures")).unwrap();
        copy(&common::root().join("examples"), &path.join("examples"));
        std::fs::copy(path.join("examples/s000-ch3b-1.json"), path.join("lectures/slider.json")).unwrap();
        Self(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

fn copy(from: &Path, to: &Path) {
    std::fs::create_dir_all(to).unwrap();
    for entry in std::fs::read_dir(from).unwrap() {
        let path = entry.unwrap().path();
        let goal = to.join(path.file_name().unwrap());
        if path.is_dir() {
            copy(&path, &goal);
        } else {
            std::fs::copy(&path, goal).unwrap();
        }
    }
}

fn linkgram(folder: &Path, arguments: &[String]) -> (i32, String, String) {
    let output =
        Command::new(env!("CARGO_BIN_EXE_linkgram")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

fn text_of(topic: &str) -> String {
    std::fs::read_to_string(common::root().join(format!("docs/{topic}.md"))).unwrap()
}

fn readme() -> String {
    std::fs::read_to_string(common::root().join("README.md")).unwrap()
}

/// The fenced blocks of a kind.
fn blocks(text: &str, kind: &str) -> Vec<String> {
    let mut found = Vec::new();
    let mut open: Option<String> = None;
    for line in text.lines() {
        match (&mut open, line) {
            (Some(block), "```") => {
                found.push(std::mem::take(block));
                open = None;
            }
            (Some(block), line) => {
                block.push_str(line);
                block.push('\n');
            }
            (None, line) if line == format!("```{kind}") => open = Some(String::new()),
            (None, _) => {}
        }
    }
    assert!(open.is_none(), "a block without an end");
    found
}

/// The words of a command, quotes taken off.
fn words(line: &str) -> Vec<String> {
    let mut words = vec![String::new()];
    let mut quoted = false;
    for c in line.chars() {
        match c {
            '"' => quoted = !quoted,
            ' ' if !quoted => words.push(String::new()),
            c => words.last_mut().unwrap().push(c),
        }
    }
    words
}

/// Runs every block of a text in a folder: scenes must hold, answers are written for the commands that follow, commands
/// must end well.
fn run_all(name: &str, text: &str, scene_is: &str) {
    let folder = Folder::new(name);
    for (index, block) in blocks(text, "json").iter().enumerate() {
        let value: Value =
            serde_json::from_str(block).unwrap_or_else(|e| panic!("{name}, block {index}: {e}"));
        if value.get("links").is_none() {
            std::fs::write(folder.0.join("answers.json"), block).unwrap();
            continue;
        }
        std::fs::write(folder.0.join(scene_is), block).unwrap();
        let (code, out, err) = linkgram(&folder.0, &["check".to_owned(), scene_is.to_owned()]);
        assert_eq!(code, 0, "{name}, block {index}: {out}{err}\n{block}");
        let drawn = ["draw", scene_is, "--format", "svg"].map(str::to_owned);
        let (code, out, err) = linkgram(&folder.0, &drawn);
        assert!(code == 0 && out.contains("<svg"), "{name}, block {index}: {err}\n{block}");
    }
    for block in blocks(text, "sh") {
        for line in block.lines() {
            let words = words(line);
            if words[0] == "cargo" {
                continue;
            }
            assert_eq!(words[0], "linkgram", "{line}");
            let (code, _, err) = linkgram(&folder.0, &words[1..]);
            // What a student handed in may be wrong: that is no fault of the command.
            let fine = code == 0 || (code == 1 && words[1] == "grade");
            assert!(fine, "{name}: {line}: exit {code}: {err}");
            for file in words.windows(2).filter(|pair| pair[0] == "-o").map(|pair| &pair[1]) {
                assert!(folder.0.join(file).exists(), "{line}: no {file}");
            }
        }
    }
}

#[test]
fn the_examples_of_scene_and_quantities() {
    run_all("scene", &text_of("scene"), "scene.json");
    run_all("quantities", &text_of("quantities"), "scene.json");
    run_all("forces", &text_of("forces"), "scene.json");
}

#[test]
fn the_examples_of_formats_and_sweeps() {
    run_all("formats", &text_of("formats"), "scene.json");
    run_all("sweeps", &text_of("sweeps"), "scene.json");
}

#[test]
fn the_examples_of_grading_and_exams() {
    run_all("grading", &text_of("grading"), "scene.json");
    run_all("exams", &text_of("exams"), "scene.json");
}

#[test]
fn the_examples_of_golden_and_accuracy() {
    run_all("golden", &text_of("golden"), "scene.json");
    run_all("accuracy", &text_of("accuracy"), "scene.json");
}

#[test]
fn the_examples_of_the_readme() {
    let readme = readme();
    assert!(readme.lines().count() <= 150, "a newcomer's page");
    run_all("readme", &readme, "piston.json");
    // The slip that the README shows.
    let wrong = blocks(&readme, "json")[0].replace("\"length\": 120", "\"lenght\": 120");
    let told = scene::read(&wrong, "piston.json").unwrap_err().to_string();
    assert!(readme.contains(&format!("``{told}``")), "{told}");
    for topic in readme.split("linkgram help ").skip(1) {
        let topic: String = topic.chars().take_while(char::is_ascii_alphabetic).collect();
        assert!(TOPICS.contains(&topic.as_str()) || topic == "TOPIC", "help on {topic}?");
    }
}

/// What stands between back quotes and looks like JSON is JSON.
#[test]
fn what_looks_like_json_is_json() {
    for text in TOPICS.map(text_of).into_iter().chain([readme()]) {
        for line in text.lines() {
            for code in line.split('`').skip(1).step_by(2) {
                let whole = if code.starts_with('"') && code.contains("\":") {
                    format!("{{{code}}}")
                } else {
                    code.to_owned()
                };
                let filled = whole.replace('…', "1");
                if whole.starts_with("{\"") {
                    assert!(serde_json::from_str::<Value>(&filled).is_ok(), "{code}");
                }
            }
        }
    }
}

/// The terminal prints what stands in `docs/`, line for line.
#[test]
fn help_prints_the_topics() {
    let ask = |words: &[&str]| {
        let words: Vec<String> = words.iter().map(|word| (*word).to_owned()).collect();
        linkgram(common::root(), &words)
    };
    for topic in TOPICS {
        let (code, out, err) = ask(&["help", topic]);
        assert_eq!((code, err.as_str()), (0, ""));
        assert_eq!(out, text_of(topic));
        assert!(out.lines().all(|line| !line.contains('\u{1b}')));
    }
    let (code, out, _) = ask(&["help"]);
    assert!(code == 0 && TOPICS.iter().all(|topic| out.contains(&format!("  {topic}"))), "{out}");
    assert!(out.contains("draw") && out.contains("what a scene may ask for"), "{out}");
    let (code, out, _) = ask(&["help", "draw"]);
    assert!(code == 0 && out.contains("--figure"), "{out}");
    let (code, out, _) = ask(&["help", "golden", "bless"]);
    assert!(code == 0 && out.contains("goldens"), "{out}");
    let (code, out, err) = ask(&["help", "quantity"]);
    assert!(code == 2 && out.is_empty() && err.contains("did you mean quantities"), "{err}");
    let (code, _, err) = ask(&["help", "draw", "scene"]);
    assert!(code == 2 && err.contains("no help on scene"), "{err}");
    let (code, out, _) = ask(&["--help"]);
    assert!(code == 0 && out.contains("linkgram help"), "{out}");
}

/// The list of quantities is the reader's own.
#[test]
fn the_table_of_quantities_is_whole() {
    let text = text_of("quantities");
    for (form, meaning) in names_of_quantities() {
        assert!(text.contains(&format!("| `{form}` | {meaning} |")), "{form}: {meaning}");
    }
}
