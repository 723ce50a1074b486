//! Nothing that is missing becomes the origin or zero: a lint over the rooms of both solvers.
//!
//! A place that no step has found is not a point, a rate that nobody has read is not zero, and what cannot be drawn
//! is a refusal with its reason. The shapes below are how the opposite habit looks in Rust. Where one of them is
//! right it stands in the list with the reason why.

#![allow(clippy::unwrap_used, reason = "a test")]

use std::path::{Path, PathBuf};

/// What must not be written.
const SHAPES: [&str; 22] = [
    "unwrap_or(origin",
    "unwrap_or_else(|| self.board.origin())",
    "unwrap_or_else(|| self.rest())",
    "unwrap_or(0.0)",
    "unwrap_or(0)",
    "unwrap_or([0.0",
    "unwrap_or(centre)",
    "unwrap_or(pin)",
    "unwrap_or_default()",
    "map_or(0.0",
    "map_or([0.0",
    "else { return };",
    "else { return Ok(()) }",
    "else { return self.board.origin()",
    "else { return self.rest()",
    "else { return self.board.rightward()",
    "=> self.board.origin()",
    "=> self.board.rightward()",
    "=> self.rest()",
    "no_length()",
    "slide: 0,",
    "(own_x, own_x)",
];

/// Where one of them is right: file, a part of the line, and why.
const RIGHT: &[(&str, &str, &str)] = &[
    (
        "analytic/assembly.rs",
        "direction(&hints).unwrap_or(0.0)",
        "where an iteration starts decides nothing but where it may end",
    ),
    (
        "analytic/assembly.rs",
        "nearest.map_or(0.0",
        "where an iteration starts decides nothing but where it may end",
    ),
    (
        "analytic/cycle.rs",
        "self.mean.map_or(0.0, |mean| mean.bound)",
        "of two given curves no mean is taken that could be off",
    ),
    ("analytic/model.rs", ".unwrap_or([0.0; 2]);", "lengths may be counted from anywhere"),
    (
        "graphical/auxiliary/klein.rs",
        "self.crank_rates(crank) else { return }",
        "a construction that was asked for beside the solution has told why it does not exist",
    ),
    (
        "graphical/auxiliary/klein.rs",
        "klein.acceleration else { return }",
        "nothing more to read where only velocities were asked for",
    ),
    ("graphical/centrodes.rs", ".unwrap_or([0.0; 2]);", "a locus may be drawn about any origin"),
    ("graphical/centrodes.rs", "ring.last().map_or(0.0", "the length of an empty ring"),
    (
        "graphical/centrodes.rs",
        "unwrap_or_default()",
        "a sign is chosen by it, and where it is zero either is right",
    ),
    (
        "graphical/centrodes.rs",
        "finite(b.loci[self.which])) else { return }",
        "what lies at infinity has no curve to refine",
    ),
    (
        "graphical/draughtsman.rs",
        "None if self.mechanism.is_fixed(point) => self.board.origin(),",
        "the image of a fixed point is the pole",
    ),
    ("graphical/draughtsman.rs", "p.vectors.get(vector)) else { return }", "a step list without a polygon"),
    ("graphical/scales.rs", "map_or([0.0; 2]", "the size of what has no ink"),
    ("graphical/pose.rs", "return (own_x, own_x);", "the axes of what stands in the world"),
    ("graphical/position.rs", "m + score.unwrap_or(0.0)", "a sum begins at zero"),
    ("graphical/position.rs", "score.unwrap_or(0.0) + m", "a sum begins at zero"),
    ("graphical/position.rs", "let Some(link) = link else { return };", "nothing rides where no link does"),
    (
        "graphical/forces/rolling.rs",
        "None => self.rest(),",
        "where no force has a moment nothing is to be balanced",
    ),
    ("graphical/reading.rs", "None if self.translates[link.0] => self.rest(),", "it does not turn"),
    (
        "graphical/trial.rs",
        "closing_unknown(closing) else { return };",
        "a given angle leaves nothing to read",
    ),
    ("graphical/velocity.rs", "= kind else { return };", "a group of another kind is another construction's"),
    (
        "graphical/dyad.rs",
        "kind.unknowns(self.mechanism) else { return };",
        "a group of another kind is another construction's",
    ),
    (
        "graphical/velocity.rs",
        "points.first().copied().unwrap_or(pin)",
        "a link that rides has a first joint: the file says so",
    ),
];

fn sources(folder: &Path, list: &mut Vec<PathBuf>) {
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            if path.file_name().is_some_and(|name| name != "tests") {
                sources(&path, list);
            }
        } else if path.extension().is_some_and(|e| e == "rs") {
            list.push(path);
        }
    }
}

#[test]
fn what_is_missing_never_becomes_the_origin_or_zero() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    for room in ["src/graphical", "src/analytic"] {
        sources(&root.join(room), &mut files);
    }
    files.sort();
    assert!(files.len() > 30, "the rooms are gone");
    let mut used = vec![false; RIGHT.len()];
    let mut wrong = Vec::new();
    for file in &files {
        let name = file.strip_prefix(root).unwrap().to_string_lossy().replace('\\', "/");
        let text = std::fs::read_to_string(file).unwrap();
        // Tests of a file stand at its end.
        for (number, line) in text.lines().enumerate().take_while(|(_, line)| *line != "#[cfg(test)]") {
            let line = line.trim();
            if line.starts_with("//") || !SHAPES.iter().any(|shape| line.contains(shape)) {
                continue;
            }
            match RIGHT.iter().position(|(of, part, _)| name.ends_with(of) && line.contains(part)) {
                Some(index) => used[index] = true,
                None => wrong.push(format!("{name}:{}: {line}", number + 1)),
            }
        }
    }
    assert!(wrong.is_empty(), "missing must be a refusal, not a value:\n{}", wrong.join("\n"));
    let stale: Vec<_> = RIGHT.iter().zip(used).filter(|(_, used)| !used).map(|(entry, _)| entry).collect();
    assert!(stale.is_empty(), "these are no longer in the code: {stale:#?}");
}
