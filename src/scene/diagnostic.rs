//! What is wrong with a scene file, where, and how to mend it.

use thiserror::Error;

use super::json::Value;
use crate::terminal::short_line;

/// One clear error in a scene file.
///
/// Displayed as one line: `scene.json:7:24: links.3.length: what is wrong; help: the mend`.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{file}:{line}:{column}: {}{what}{}", prefix(.path), suffix(.mend.as_deref()))]
pub struct Diagnostic {
    /// The file, as its reader named it (`-` for standard input).
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
    /// Keys from the root to the place (`links.3.length`, `slides[0].on`); empty for the whole file.
    pub path: String,
    /// What is wrong, one clause in plain English.
    pub what: String,
    /// How to mend it, if that can be said.
    pub mend: Option<String>,
}

fn prefix(path: &str) -> String {
    if path.is_empty() { String::new() } else { format!("{path}: ") }
}

fn suffix(mend: Option<&str>) -> String {
    mend.map_or_else(String::new, |m| format!("; help: {m}"))
}

/// What is wrong at a byte of the text; becomes a [`Diagnostic`] when the reader is left.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Fault {
    /// Byte offset of the value or key.
    pub(crate) at: usize,
    what: String,
    mend: Option<String>,
}

/// The result of every step of reading.
pub(crate) type Res<T> = Result<T, Fault>;

impl Fault {
    pub(crate) fn new(at: usize, what: impl Into<String>) -> Self {
        Self { at, what: what.into(), mend: None }
    }

    /// Says how to mend it.
    pub(crate) fn mend(mut self, mend: impl Into<String>) -> Self {
        self.mend = Some(mend.into());
        self
    }

    /// Offers the nearest known name; where none is near, all of them if they are few.
    pub(crate) fn known<'n>(self, wrong: &str, known: impl IntoIterator<Item = &'n str>) -> Self {
        let known: Vec<&str> = known.into_iter().collect();
        if let Some(near) = nearest(wrong, &known) {
            return self.mend(format!("did you mean `{near}`?"));
        }
        match known.len() {
            0 => self,
            1..=20 => self.mend(format!("known are {}", list(&known))),
            more => self.mend(format!("known are {} and {} more", list(&known[..12]), more - 12)),
        }
    }

    /// Adds file, line, column and path.
    pub(crate) fn locate(self, file: &str, text: &str, root: Option<&Value<'_>>) -> Diagnostic {
        let at = floor_char(text, self.at);
        let line_start = text[..at].rfind('\n').map_or(0, |n| n + 1);
        Diagnostic {
            file: file.to_owned(),
            line: text[..at].matches('\n').count() + 1,
            column: text[line_start..at].chars().count() + 1,
            path: root.map_or_else(String::new, |r| short_line(&r.path_to(self.at))),
            what: short_line(&self.what),
            mend: self.mend.as_deref().map(short_line),
        }
    }
}

/// The last character boundary that is not after `at`.
fn floor_char(text: &str, at: usize) -> usize {
    let mut at = at.min(text.len());
    while !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}

/// Names between back quotes, joined with commas.
pub(crate) fn list(names: &[&str]) -> String {
    names.iter().map(|n| format!("`{n}`")).collect::<Vec<_>>().join(", ")
}

/// The known name that is nearest to a wrong one, if it is near enough to be meant.
#[must_use]
pub fn nearest<'n>(wrong: &str, known: &[&'n str]) -> Option<&'n str> {
    // Longer texts are no slips of the pen, and the distance costs their product.
    if wrong.chars().count() > 64 {
        return None;
    }
    let lower = wrong.to_lowercase();
    let count = |text: &str| text.chars().count();
    known
        .iter()
        .filter_map(|&name| {
            let other = name.to_lowercase();
            let longer = count(&lower).max(count(&other));
            // An abbreviation or a longer form (`deg`, `degrees`) is as near as one slip.
            let stem = count(&lower).min(count(&other)) > 2
                && (lower.starts_with(&other) || other.starts_with(&lower));
            let distance = strsim::damerau_levenshtein(&lower, &other);
            let distance = if stem { distance.min(1) } else { distance };
            // Two names without a letter in common are strangers, however short.
            let near = distance <= (longer / 3).max(1) && (distance < longer);
            let common = lower.chars().zip(other.chars()).take_while(|(a, b)| a == b).count();
            near.then_some(((distance, usize::MAX - common), name))
        })
        .min_by_key(|(rank, _)| *rank)
        .map(|(_, name)| name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_takes_slips_and_leaves_strangers() {
        let keys = ["length", "line", "sides", "shape", "joins"];
        assert_eq!(nearest("lenght", &keys), Some("length"));
        assert_eq!(nearest("Length", &keys), Some("length"));
        assert_eq!(nearest("join", &keys), Some("joins"));
        assert_eq!(nearest("colour", &keys), None);
        assert_eq!(nearest("degrees", &["deg", "rad"]), Some("deg"));
        assert_eq!(nearest("E", &["A", "B", "O2"]), None);
        assert_eq!(nearest("02", &["A", "B", "O2"]), Some("O2"));
        assert_eq!(nearest("cmm", &["mm", "cm"]), Some("cm"));
    }

    #[test]
    fn one_line_with_all_parts() {
        let text = "{\n \"ä\": 7}";
        let fault = Fault::new(text.find('7').unwrap(), "too much").mend("take less");
        assert_eq!(fault.locate("s.json", text, None).to_string(), "s.json:2:7: too much; help: take less");
    }
}
