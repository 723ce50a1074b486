//! Every pair's construction as a text, operation by operation, against the golden tape in `golden/tapes/`:
//! to be laid beside the step lists of the textbooks.
//!
//! `LINKGRAM_BLESS=1 cargo test --test all tapes::` makes the present tapes the golden ones; read them before you
//! commit them.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use std::fmt::Write;
use std::path::{Path, PathBuf};

use linkgram::plan::Extent;

/// One scene for every kind of group.
const SCENES: &[&str] = &[
    "s000-ch3a-1",
    "s000-ch3a-2",
    "s000-ch3a-3-fit",
    "pairs/arc-guide",
    "pairs/coupler-driven",
    "pairs/curved-yoke",
    "pairs/differential",
    "pairs/driven-wheel",
    "pairs/driven-wheel-in-ring",
    "pairs/eccentric-gear",
    "pairs/elliptic-trammel",
    "pairs/higher-group",
    "pairs/links-on-two-guides",
    "pairs/oblique-yoke",
    "pairs/oldham",
    "pairs/oscillating-cylinder",
    "pairs/pin-on-two-guides",
    "pairs/planet-and-rod",
    "pairs/rack",
    "pairs/rack-on-moving-guide",
    "pairs/reversed-yoke",
    "pairs/riding-link",
    "pairs/riding-link-on-slot",
    "pairs/rod-on-moving-guide",
    "pairs/trammel-driven-by-bar",
    "pairs/wheel-on-moving-plane",
    "pairs/wheel-on-plane",
];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn tape(scene: &str) -> String {
    let path = root().join("examples").join(format!("{scene}.json"));
    let text = std::fs::read_to_string(&path).unwrap();
    let scene = linkgram::scene::read(&text, scene).unwrap();
    let solved = linkgram::solve::solve(&scene, Extent::Asked, linkgram::sheet::scale::for_scene).unwrap();
    let mut out = solved.plan.explain(&scene.mechanism, &solved.structure).to_string();
    let mut purpose = "";
    // At the scales of the page, where they can be read beside a textbook.
    let (mechanism, scales) = (&scene.mechanism, solved.scales);
    let drawn = linkgram::graphical::construct(mechanism, &solved.structure, &solved.plan, scales).unwrap();
    for stroke in drawn.tape.strokes() {
        if stroke.purpose != purpose {
            purpose = stroke.purpose;
            writeln!(out, "{purpose}").unwrap();
        }
        let [x, y] = stroke.at.map(|c| if c.abs() < 5e-5 { 0.0 } else { c });
        writeln!(out, "    {:24} ({x:.4}, {y:.4})", stroke.operation.name()).unwrap();
    }
    out
}

#[test]
fn every_tape_is_its_golden() {
    let folder = root().join("golden/tapes");
    let bless = std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1");
    let mut different: Vec<PathBuf> = Vec::new();
    for scene in SCENES {
        let path = folder.join(format!("{}.txt", scene.replace('/', "-")));
        let actual = tape(scene);
        if bless {
            std::fs::create_dir_all(&folder).unwrap();
            std::fs::write(&path, actual).unwrap();
        } else if std::fs::read_to_string(&path).ok().as_deref() != Some(&actual) {
            different.push(path);
        }
    }
    assert!(different.is_empty(), "these tapes differ from their golden: {different:#?}");
}
