//! What hostile hands try: files that are too large, too deep or no files, names that a terminal or another program
//! obeys, links and left-overs where something is to be written, and a fuzzer over everything.

#![allow(clippy::unwrap_used, reason = "helpers of tests: a failed unwrap is a failed test")]

use std::time::{Duration, Instant};

use crate::common;

mod banks;
mod commands;
mod conflicts;
mod contacts;
mod dice;
mod far;
mod folder;
mod fuzz;
mod mutation;
mod readers;
mod reading;
mod scale;
mod unasked;
#[cfg(unix)]
mod writing;

/// A clock of what this thread computes, where the system tells it: a busy machine makes nothing slow.
pub(crate) struct Clock(Instant, Option<Duration>);

impl Clock {
    pub(crate) fn start() -> Self {
        Self(Instant::now(), reckoned())
    }

    pub(crate) fn elapsed(&self) -> Duration {
        match (self.1, reckoned()) {
            (Some(then), Some(now)) => now.saturating_sub(then),
            _ => self.0.elapsed(),
        }
    }
}

fn reckoned() -> Option<Duration> {
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    told.split(' ').next()?.parse().ok().map(Duration::from_nanos)
}

/// The README tells every limit as the code has it.
#[test]
fn the_limits_stand_in_the_readme() {
    let readme = std::fs::read_to_string(common::root().join("README.md")).unwrap();
    let table = linkgram::limits::table();
    assert!(readme.contains(&table), "the README has another table than this:\n{table}");
}
