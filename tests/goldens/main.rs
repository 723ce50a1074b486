//! This project's own goldens, kept with `linkgram::golden`: every example, every kind of the catalogue, and some of them
//! as questions, step by step and in other languages, as `golden/suite.json` lists them.
//!
//! `LINKGRAM_BLESS=1 cargo test --test all goldens::` (or `linkgram golden bless golden`) makes the present figures the
//! golden ones. Look at the pictures before you commit them, and commit a bless on its own. A failure writes
//! `target/golden-report/report.html`: expected, actual and difference.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

#[cfg(feature = "png")]
mod readme;
mod suites;

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use crate::sheets::{examples, root};
use linkgram::golden::Suite;

#[test]
fn every_figure_is_its_golden() {
    let target = Path::new(env!("CARGO_TARGET_TMPDIR")).parent().unwrap();
    linkgram::golden::assert(root().join("golden"), target.join("golden-report/report.html"));
}

/// An example or a kind that nobody lists would have no golden.
#[test]
fn the_suite_has_every_example_and_every_kind() {
    let suite = Suite::open(&root().join("golden")).unwrap();
    let names: BTreeSet<&str> = suite.cases().iter().map(|case| case.name.as_str()).collect();
    for example in examples() {
        assert!(names.contains(example.name.as_str()), "{}", example.name);
    }
    for kind in linkgram::catalogue::KINDS {
        assert!(names.contains(format!("catalogue.{}", kind.name).as_str()), "{}", kind.name);
    }
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
