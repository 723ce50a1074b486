//! What is taken in at most. Whoever reads files of strangers needs an end to everything that they may hold; all
//! ends stand here, and the README tells them in one table.

use std::fmt::Write;

/// A scene, answers, a drawing, a suite's own file: bytes.
pub const FILE: usize = 8 << 20;
/// A golden that was blessed: bytes.
pub const GOLDEN: usize = 64 << 20;
/// Objects and lists inside one another; the deepest scene has six.
pub const DEPTH: usize = 16;
/// Entries of one object or list; links, points, pairs of a scene.
pub const ENTRIES: usize = 10_000;
/// Values of one file, counted together.
pub const VALUES: usize = 500_000;
/// Knots of a table over an angle, areas of a diagram.
pub const KNOTS: usize = 1_000;
/// Quantities that a scene asks for by name; loads; springs.
pub const ASKED: usize = 1_000;
/// Folders inside one another.
pub const FOLDERS: usize = 64;
/// Files and folders that are looked at for scenes.
pub const FILES: usize = 100_000;
/// Figures of one golden suite.
pub const FIGURES: usize = 10_000;
/// Answers that one hands in: values, lengths and points together.
pub const ANSWERS: usize = 1_000;
/// Coordinates and lengths on paper: a kilometre (mm).
pub const PAPER_MM: f64 = 1e6;
/// Rows of a table of answers.
pub const ROWS: usize = 10_000;
/// Elements of a drawing inside one another.
pub const ELEMENTS_DEEP: usize = 256;
/// Elements of a drawing.
pub const ELEMENTS: usize = 100_000;
/// Attributes of one element of a drawing.
pub const ATTRIBUTES: usize = 256;
/// Namespaces that a drawing declares.
pub const NAMESPACES: usize = 256;
/// Dots, corners and ends of lines in a drawing.
pub const MARKS: usize = 200_000;
/// Letters of a drawing that name points.
pub const LETTERS: usize = 1_000;
/// The declarations of a drawing's document type: bytes.
pub const DOCTYPE: usize = 8 << 10;
/// Uses of what they declare.
pub const ENTITIES: usize = 1_000;
/// Other positions on one skeleton.
pub const POSITIONS: usize = 24;
/// Positions of a sweep.
pub const STEPS: u32 = 1_000_000;
/// A line of a message: characters.
pub const MESSAGE: usize = 300;

/// A limit, as the README tells it: on what, and how much.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Limit {
    /// Where it holds.
    pub of: &'static str,
    /// What is counted.
    pub what: &'static str,
    /// How much of it is taken.
    pub most: String,
}

/// Every limit, in the order of the README.
#[must_use]
pub fn all() -> Vec<Limit> {
    let limit = |of, what, most: String| Limit { of, what, most };
    let mib = |bytes: usize| format!("{} MiB", bytes >> 20);
    vec![
        limit("any file", "size", mib(FILE)),
        limit("JSON", "levels", grouped(DEPTH)),
        limit("JSON", "entries of one object or list", grouped(ENTRIES)),
        limit("JSON", "values in all", grouped(VALUES)),
        limit("scene", "links, points, pairs of a kind", grouped(ENTRIES)),
        limit("scene", "numbers, SI", "10⁻⁶⁰ to 10⁶⁰, and 0".to_owned()),
        limit("scene", "other positions", grouped(POSITIONS)),
        limit(
            "scene",
            "names in `find`, loads, springs, knots of a table, areas of a diagram",
            grouped(KNOTS),
        ),
        limit("sweep", "steps", grouped(STEPS as usize)),
        limit("answers", "values, lengths and points together", grouped(ANSWERS)),
        limit("answers", "lengths and coordinates on paper", "1 km".to_owned()),
        limit("answers as a table", "rows", grouped(ROWS)),
        limit("drawing (SVG)", "elements", grouped(ELEMENTS)),
        limit("drawing (SVG)", "elements inside one another", grouped(ELEMENTS_DEEP)),
        limit("drawing (SVG)", "attributes of one element", grouped(ATTRIBUTES)),
        limit("drawing (SVG)", "namespaces", grouped(NAMESPACES)),
        limit("drawing (SVG)", "dots, corners and ends of lines", grouped(MARKS)),
        limit("drawing (SVG)", "letters that name points", grouped(LETTERS)),
        limit(
            "drawing (SVG)",
            "document type",
            format!("{} KiB, used {} times", DOCTYPE >> 10, grouped(ENTITIES)),
        ),
        limit("folder", "folders inside one another", grouped(FOLDERS)),
        limit("folder", "files", grouped(FILES)),
        limit("golden suite", "figures", grouped(FIGURES)),
        limit("golden suite", "size of a golden", mib(GOLDEN)),
        limit("message", "characters of a line", grouped(MESSAGE)),
    ]
}

/// The table of the README.
#[must_use]
pub fn table() -> String {
    let mut table = "| of | what | at most |\n|---|---|---|\n".to_owned();
    for Limit { of, what, most } in all() {
        let _ = writeln!(table, "| {of} | {what} | {most} |");
    }
    table
}

/// `100,000`.
pub(crate) fn grouped(number: usize) -> String {
    let digits = number.to_string();
    let mut out = String::new();
    for (index, digit) in digits.chars().enumerate() {
        if index > 0 && (digits.len() - index).is_multiple_of(3) {
            out.push(',');
        }
        out.push(digit);
    }
    out
}
