//! The finished sheets of the examples, for the tests that look at them from outside.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use std::path::{Path, PathBuf};

use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::{self, Language};
use linkgram::solve::Solved;

/// An example that has a sheet.
pub struct Example {
    /// Its file name without the extension: the name of its golden.
    pub name: String,
    /// Its file.
    pub path: PathBuf,
}

/// The root of the repository.
pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every scene that is to be solved, sorted by name: the examples and the errata, not the refusals.
pub fn examples() -> Vec<Example> {
    let mut all: Vec<Example> = ["examples", "examples/centres", "examples/errata", "examples/pairs"]
        .iter()
        .flat_map(|folder| std::fs::read_dir(root().join(folder)).unwrap())
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "json"))
        .map(|path| Example { name: path.file_stem().unwrap().to_str().unwrap().to_owned(), path })
        .collect();
    all.sort_by(|a, b| a.name.cmp(&b.name));
    assert!(all.len() >= 15, "the examples are there");
    assert!(all.windows(2).all(|w| w[0].name != w[1].name), "two examples of one name would share a golden");
    all
}

/// Reads, solves and draws an example, as `linkgram draw` does.
pub fn draw(example: &Example) -> (Scene, Solved, String) {
    draw_text(&example.name, &std::fs::read_to_string(&example.path).unwrap())
}

/// The solution of the text of a scene, in English.
pub fn draw_text(name: &str, text: &str) -> (Scene, Solved, String) {
    let scene = linkgram::scene::read(text, name).unwrap();
    let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene)
        .unwrap_or_else(|error| panic!("{name}: {error}"));
    let figure = sheet::solution(&scene, &solved.solution.construction, Language::English);
    let svg = linkgram::render::svg::write(&figure);
    (scene, solved, svg)
}
