//! Names of scene and answers as the sheet prints them: a student reads ω₃, not `omega(3)`.

use crate::markup::escaped;
use crate::sheet::Symbol;

/// The letters of angular acceleration.
pub(super) const ANGULAR_ACCELERATION: [char; 2] = ['α', 'ε'];

/// What a report names.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Symbols {
    /// By the name in scene and answers, the longest first.
    all: Vec<(String, Symbol)>,
    /// The letter of angular acceleration on the sheet, where it has one.
    letter: Option<char>,
}

impl Symbols {
    /// The first of several with one name holds.
    pub(super) fn new(mut all: Vec<(String, Symbol)>, letter: Option<char>) -> Self {
        all.sort_by_key(|(name, _)| std::cmp::Reverse(name.len()));
        let mut known = Vec::new();
        all.retain(|(name, _)| {
            !known.contains(name) && {
                known.push(name.clone());
                true
            }
        });
        Self { all, letter }
    }

    /// What stands between names, with the letter of the sheet for angular acceleration.
    fn words(&self, text: &str) -> String {
        match self.letter {
            Some(letter) => text.replace(ANGULAR_ACCELERATION, letter.encode_utf8(&mut [0; 4])),
            None => text.to_owned(),
        }
    }

    /// A text with every name as the sheet prints it, in plain characters.
    #[must_use]
    pub fn plain(&self, text: &str) -> String {
        self.told(text, |words| self.words(words), |symbol| &symbol.plain)
    }

    /// The same as hypertext.
    #[must_use]
    pub fn html(&self, text: &str) -> String {
        self.told(text, |words| escaped(&self.words(words)), |symbol| &symbol.html)
    }

    fn told(
        &self,
        text: &str,
        between: impl Fn(&str) -> String,
        symbol: impl Fn(&Symbol) -> &String,
    ) -> String {
        let mut out = String::with_capacity(text.len());
        let (mut rest, mut plain) = (text, text);
        let mut before: Option<char> = None;
        while let Some(next) = rest.chars().next() {
            // A name does not begin in the middle of a word: v(B) is no part of slipv(B).
            let begins = before.is_none_or(|c| !c.is_alphanumeric());
            let found = self.all.iter().find(|(name, _)| {
                let ends = rest.strip_prefix(name.as_str()).map(|after| after.chars().next());
                begins && ends.is_some_and(|after| after.is_none_or(|c| !c.is_alphanumeric()))
            });
            match found {
                Some((name, known)) => {
                    out.push_str(&between(&plain[..plain.len() - rest.len()]));
                    out.push_str(symbol(known));
                    before = name.chars().last();
                    rest = &rest[name.len()..];
                    plain = rest;
                }
                None => {
                    before = Some(next);
                    rest = &rest[next.len_utf8()..];
                }
            }
        }
        out + &between(plain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_told_as_whole_words_and_the_rest_stays() {
        let symbol = |plain: &str| Symbol { plain: plain.to_owned(), html: format!("<i>{plain}</i>") };
        let all = [("v(B)", "V_B"), ("v(B/A)", "V_BA"), ("Ef", "E_f"), ("x:b", "b"), ("x:b'", "b′")];
        let all = all.map(|(name, plain)| (name.to_owned(), symbol(plain))).to_vec();
        let symbols = Symbols::new(all.clone(), None);
        assert_eq!(
            symbols.plain("v(B/A) read for v(B); slipv(B), Effort, Ef."),
            "V_BA read for V_B; slipv(B), Effort, E_f."
        );
        assert_eq!(symbols.plain("x:b' and x:b"), "b′ and b");
        assert_eq!(symbols.html("v(B) < 3 & Ef"), "<i>V_B</i> &lt; 3 &amp; <i>E_f</i>");
        assert_eq!(Symbols::new(all, Some('α')).plain("ω or ε of v(B)"), "ω or α of V_B");
    }
}
