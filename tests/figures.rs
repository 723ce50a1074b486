//! The figures of `examples/constructions` against the blessed ones in `golden/figures`, byte for byte.
//!
//! `LINKGRAM_BLESS=1 cargo test --test figures` makes the present figures the golden ones. Look at them before you
//! commit them.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

mod common;

use std::path::PathBuf;
use std::process::Command;

use common::root;

#[test]
fn every_figure_is_its_golden() {
    let blessing = std::env::var_os("LINKGRAM_BLESS").is_some_and(|v| v == "1");
    let folder = root().join("examples/constructions");
    let mut scenes: Vec<PathBuf> =
        std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scenes.sort();
    assert!(scenes.len() >= 4, "the examples are gone");
    let mut differ = Vec::new();
    for scene in scenes {
        let output = Command::new(env!("CARGO_BIN_EXE_linkgram")).arg("draw").arg(&scene).output().unwrap();
        assert!(output.status.success(), "{scene:?}: {}", String::from_utf8_lossy(&output.stderr));
        let name = format!("golden/figures/{}.svg", scene.file_stem().unwrap().to_str().unwrap());
        let golden = root().join(&name);
        if blessing {
            std::fs::create_dir_all(golden.parent().unwrap()).unwrap();
            std::fs::write(&golden, &output.stdout).unwrap();
        } else if std::fs::read(&golden).ok().as_ref() != Some(&output.stdout) {
            differ.push(name);
        }
    }
    assert!(differ.is_empty(), "{differ:?} differ; draw them, look, and bless with LINKGRAM_BLESS=1");
}
