//! What hostile hands try: files that are too large, too deep or no files, names that a terminal or another program
//! obeys, links and left-overs where something is to be written, and a fuzzer over everything.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

#[path = "../common/mod.rs"]
mod common;

mod banks;
mod dice;
mod folder;
mod fuzz;
mod mutation;
mod reading;
#[cfg(unix)]
mod writing;

/// The README tells every limit as the code has it.
#[test]
fn the_limits_stand_in_the_readme() {
    let readme = std::fs::read_to_string(common::root().join("README.md")).unwrap();
    let table = linkgram::limits::table();
    assert!(readme.contains(&table), "the README has another table than this:\n{table}");
}
