//! What the integration tests share: reading and drawing scenes, an exact arithmetic, a maker of chains.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

pub(crate) mod chains;
pub(crate) mod exact;
pub(crate) mod givens;
pub(crate) mod hand_in;
pub(crate) mod oracle;
pub(crate) mod plane;

use std::path::{Path, PathBuf};

use linkgram::graphical::{self, DrawError, Extents, Scales, Solution};
use linkgram::mechanism::PointId;
use linkgram::mechanism::quantity::Answer;
use linkgram::mechanism::structure::Structure;
use linkgram::plan::{Extent, Plan};
use linkgram::scene::{self, Scene};

/// The project's root.
pub(crate) fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// Every scene under `examples/`, in the order of their names.
pub(crate) fn example_paths() -> Vec<PathBuf> {
    let mut paths = Vec::new();
    let mut folders = vec![root().join("examples")];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "json") {
                paths.push(path);
            }
        }
    }
    paths.sort();
    assert!(paths.len() >= 20, "the examples are gone");
    paths
}

/// The text of an example by its file stem.
pub(crate) fn example_text(stem: &str) -> String {
    std::fs::read_to_string(root().join(format!("examples/{stem}.json"))).unwrap()
}

/// An example by its file stem.
pub(crate) fn example(stem: &str) -> Scene {
    read(&example_text(stem))
}

/// A scene that must be readable.
pub(crate) fn read(text: &str) -> Scene {
    scene::read(text, "test.json").unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// Every scene of the examples and of the catalogue that can be read, with its name.
pub(crate) fn scenes() -> Vec<(String, Scene)> {
    let of_file = |path: PathBuf| {
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        let scene = scene::read(&std::fs::read_to_string(&path).unwrap(), &name).ok()?;
        Some((name, scene))
    };
    let kinds = linkgram::catalogue::KINDS.iter();
    let kinds = kinds.map(|kind| (kind.name.to_owned(), read(kind.scene)));
    example_paths().into_iter().filter_map(of_file).chain(kinds).collect()
}

/// Scales that put each diagram on 120 mm of paper.
pub(crate) fn scales_for(extents: Extents) -> Scales {
    extents.filling(120.0)
}

/// A scene with its drawn solution.
pub(crate) struct Drawn {
    pub(crate) scene: Scene,
    pub(crate) structure: Structure,
    pub(crate) plan: Plan,
    pub(crate) scales: Scales,
    pub(crate) solution: Solution,
}

/// Draws a scene that has a structure.
pub(crate) fn try_draw(scene: &Scene, extent: Extent) -> Result<Drawn, DrawError> {
    let structure = Structure::of(&scene.mechanism).unwrap();
    let plan = Plan::new(&scene.mechanism, &structure, extent);
    let scales = scales_for(graphical::extents(&scene.mechanism, &structure, &plan)?);
    let solution = graphical::construct(&scene.mechanism, &structure, &plan, scales)?;
    Ok(Drawn { scene: scene.clone(), structure, plan, scales, solution })
}

/// Draws a scene that must have a solution.
pub(crate) fn draw(scene: &Scene) -> Drawn {
    try_draw(scene, Extent::WholeSkeleton).unwrap()
}

/// A number with its bound.
pub(crate) type Bounded = (f64, f64);

impl Drawn {
    pub(crate) fn point(&self, name: &str) -> PointId {
        self.scene.mechanism.point_named(name).unwrap()
    }

    /// The answer to an asked quantity.
    pub(crate) fn answer(&self, name: &str) -> &Answer {
        let index = self.scene.mechanism.asked.iter().position(|a| a.name == name);
        let index = index.unwrap_or_else(|| panic!("{name} is not asked"));
        &self.solution.construction.answers[index].answer
    }

    /// A scalar answer in SI units.
    pub(crate) fn scalar(&self, name: &str) -> Bounded {
        match self.answer(name) {
            Answer::Scalar { value, bound } => (*value, *bound),
            other => panic!("{name} is {other:?}"),
        }
    }

    /// A vector answer in SI units.
    pub(crate) fn vector(&self, name: &str) -> ([f64; 2], f64) {
        match self.answer(name) {
            Answer::Vector { value, bound } => (*value, *bound),
            other => panic!("{name} is {other:?}"),
        }
    }
}

/// A proptest of this many cases from a fixed seed: the same on every run.
pub(crate) fn fixed(cases: u32) -> proptest::test_runner::Config {
    proptest::test_runner::Config {
        cases,
        rng_seed: proptest::test_runner::RngSeed::Fixed(0x116b_6772_616d),
        failure_persistence: None,
        ..proptest::test_runner::Config::default()
    }
}

pub(crate) fn minus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

pub(crate) fn plus(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

pub(crate) fn cross(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

pub(crate) fn dot(a: [f64; 2], b: [f64; 2]) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn norm(a: [f64; 2]) -> f64 {
    libm::hypot(a[0], a[1])
}
