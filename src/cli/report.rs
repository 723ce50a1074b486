//! Errors of later rooms, told at the place in the file that they are about; numbers for people.

use crate::graphical::DrawError;
use crate::mechanism::quantity::{Answer, Asked};
use crate::scene::{Diagnostic, Scene, locate};
use crate::solve::SolveError;

/// The diagnostic of an error that was found after reading.
pub(super) fn diagnose(file: &str, text: &str, scene: &Scene, error: &SolveError) -> Diagnostic {
    let unit = &scene.units.length;
    let (paths, what, mend): (&[&str], String, Option<String>) = match error {
        SolveError::Structure(structure) => (
            &["inputs", "input", "links"],
            structure.to_string(),
            Some(match structure {
                crate::mechanism::structure::StructureError::UnderConstrained { left, .. } => format!(
                    "give {left} more input{}, or join or guide these links",
                    if *left == 1 { "" } else { "s" }
                ),
                crate::mechanism::structure::StructureError::OverConstrained { .. } => {
                    "take away a link, a pair or an input".to_owned()
                }
            }),
        ),
        SolveError::Draw(DrawError::CannotAssemble { why, range }) => (
            &["input.angle", "input", "inputs", "links"],
            format!("cannot be assembled: {}", why.in_unit(unit.si, &unit.symbol)),
            Some(match range {
                Some(range) => range.to_string(),
                None => "change the dimensions or the input".to_owned(),
            }),
        ),
        SolveError::Draw(DrawError::Ambiguous { pin, first, second }) => {
            let place = |p: &[f64; 2]| format!("[{}, {}]", short(p[0] / unit.si), short(p[1] / unit.si));
            (
                &["near", "links"],
                format!("ambiguous: the chain closes with {pin} at {} and at {}", place(first), place(second)),
                Some(format!("choose one, as in \"near\": {{ \"{pin}\": {} }}", place(first))),
            )
        }
        SolveError::Draw(DrawError::NoConstruction { links }) => {
            let names: Vec<String> = links.iter().map(u32::to_string).collect();
            (
                &["links"],
                format!(
                    "links {} form a group for which no graphical construction is known",
                    names.join(", ")
                ),
                Some("so far linkgram solves drivers, RRR and RRP groups with guides on link 1".to_owned()),
            )
        }
        SolveError::Indeterminate { name, why } => (
            &["find", "input"],
            format!("indeterminate here: {name}: {why}"),
            Some("turn the input a little; at this position it does not determine what is asked".to_owned()),
        ),
    };
    let (path, (line, column)) = paths
        .iter()
        .find_map(|path| locate(text, path).map(|at| (*path, at)))
        .unwrap_or(("", (1, 1)));
    Diagnostic { file: file.to_owned(), line, column, path: path.to_owned(), what, mend }
}

/// A number with seven significant digits.
pub(super) fn short(x: f64) -> String {
    let text = format!("{x:.6e}");
    text.parse::<f64>().map_or(text, |rounded| format!("{rounded}"))
}

/// An answer for people: value in its unit, with sense or direction.
pub(super) fn describe(asked: &Asked, answer: &Answer) -> String {
    let unit = &asked.unit;
    match answer {
        Answer::Scalar { value, .. } => {
            format!("{} {}", short(value / unit.si), unit.symbol)
        }
        Answer::Vector { value, .. } => {
            let [x, y] = value.map(|v| v / unit.si);
            format!("({}, {}) = {} {}", short(x), short(y), short(libm::hypot(x, y)), unit.symbol)
        }
        Answer::AtInfinity { direction, .. } => {
            let degrees = libm::atan2(direction[1], direction[0]).to_degrees();
            format!("at infinity, along {} deg", short(degrees))
        }
        Answer::Indeterminate(why) => format!("indeterminate: {why}"),
    }
}
