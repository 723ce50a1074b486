//! What may reach a terminal. Names, titles and paths come from files of strangers, and a terminal obeys what stands
//! in them: no message and no table is printed but through here.

use std::fmt::Write;

use crate::limits;

/// Whether a terminal, or a reader's eye, takes it for an order: controls, and what turns the direction of writing.
fn commands(c: char) -> bool {
    c.is_control() || matches!(c, '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// One line: whatever commands is written as JSON writes it (`\u001b`).
#[must_use]
pub(crate) fn line(text: &str) -> String {
    written(text, |_| false)
}

/// One line that is no longer than anybody reads.
#[must_use]
pub(crate) fn short_line(text: &str) -> String {
    let end = text.char_indices().nth(limits::MESSAGE).map(|(end, _)| end);
    let mut short = line(end.map_or(text, |end| &text[..end]));
    if end.is_some() {
        short.push('…');
    }
    short
}

/// Lines of text, or a JSON text: within its strings what commands is told as JSON tells it.
#[must_use]
#[cfg(feature = "cli")]
pub(crate) fn lines(text: &str) -> String {
    written(text, |c| matches!(c, '\n' | '\t'))
}

fn written(text: &str, kept: impl Fn(char) -> bool) -> String {
    if !text.contains(|c| commands(c) && !kept(c)) {
        return text.to_owned();
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            c if !commands(c) || kept(c) => out.push(c),
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            c => drop(write!(out, "\\u{:04x}", u32::from(c))),
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_that_a_terminal_obeys_is_left() {
        let bell = "a\u{1b}]0;x\u{7}b\u{9b}31m\u{202e}\n\tc";
        assert_eq!(line(bell), "a\\u001b]0;x\\u0007b\\u009b31m\\u202e\\n\\tc");
        assert_eq!(lines(bell), "a\\u001b]0;x\\u0007b\\u009b31m\\u202e\n\tc");
        assert_eq!(lines("متر ω\u{200e}"), "متر ω\u{200e}");
        let json = serde_json::to_string(&serde_json::json!({ "a": "\u{9b}\u{7f}" })).unwrap();
        let read: serde_json::Value = serde_json::from_str(&lines(&json)).unwrap();
        assert_eq!(read["a"], "\u{9b}\u{7f}");
        assert_eq!(short_line(&"x".repeat(limits::MESSAGE + 1)).chars().count(), limits::MESSAGE + 1);
    }
}
