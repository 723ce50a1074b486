//! What the question banks have in common: the questions in one language with their figures, and XML.

use super::Variant;
use crate::markup;
use crate::render::{self, Format, Options, RenderError};
use crate::scene::Scene;
use crate::sheet::{Figure, Language, prompt};

/// The variants of a scene as questions in one language.
#[derive(Debug, Clone)]
pub struct Bank<'a> {
    /// The title of the scene.
    pub title: String,
    /// The language of all words.
    pub language: Language,
    /// The questions.
    pub items: Vec<Item<'a>>,
}

/// One question.
#[derive(Debug, Clone)]
pub struct Item<'a> {
    /// The variant that it asks for.
    pub variant: &'a Variant,
    /// Its figure, an SVG that states what is given and what is asked.
    pub figure: String,
    /// The sheet of its solution, an SVG: told after an attempt.
    pub solution: String,
    /// What each number of the answer is, as hypertext.
    pub prompts: Vec<String>,
}

impl<'a> Bank<'a> {
    /// The questions of `scene` with their figures; `figures` are the [cards](super::card) and the
    /// [solutions](super::solution) of the variants.
    ///
    /// # Errors
    /// Where this build cannot write an SVG of these options.
    pub fn new(
        scene: &Scene,
        language: Language,
        figures: Vec<(&'a Variant, [Figure; 2])>,
        options: &Options,
    ) -> Result<Self, RenderError> {
        let words = language.words();
        let title = scene.title.in_language(words.tag).unwrap_or(words.untitled);
        let title = if words.right_to_left { isolated(title) } else { title.to_owned() };
        let item = |(variant, figures): (&'a Variant, [Figure; 2])| {
            let svg = |figure: &Figure| {
                let bytes = render::render(figure, Format::Svg, options)?;
                Ok::<_, RenderError>(String::from_utf8_lossy(&bytes).into_owned())
            };
            let [figure, solution] = [svg(&figures[0])?, svg(&figures[1])?];
            let asked = &variant.scene.mechanism.asked;
            let prompts = variant
                .answers
                .iter()
                .map(|answer| harmless(&prompt(&variant.scene, &asked[answer.asked], answer.part, language)))
                .collect();
            Ok::<_, RenderError>(Item { variant, figure, solution, prompts })
        };
        let items = figures.into_iter().map(item).collect::<Result<_, _>>()?;
        Ok(Self { title, language, items })
    }

    /// The name of a question.
    pub(super) fn name(&self, item: &Item<'_>) -> String {
        let number = item.variant.name();
        let number = if self.language.words().right_to_left { isolated(&number) } else { number };
        format!("{} · {number}", self.title)
    }

    /// The attributes of an element that holds text of this language.
    pub(super) fn direction(&self) -> &'static str {
        if self.language.words().right_to_left { "rtl" } else { "ltr" }
    }
}

/// Plain text of Arabic script: each number in it (3-1, 2.5, 007) stands as one from left to right. Viewers would set its
/// parts the other way round after a word from right to left.
fn isolated(text: &str) -> String {
    let digit = |c: char| c.is_ascii_digit();
    let joins = |c: char| matches!(c, '-' | '.' | ':' | '/' | ',');
    let characters: Vec<char> = text.chars().collect();
    let mut out = String::with_capacity(text.len() + 8);
    let mut at = 0;
    while at < characters.len() {
        if !digit(characters[at]) {
            out.push(characters[at]);
            at += 1;
            continue;
        }
        let mut end = at + 1;
        while end < characters.len()
            && (digit(characters[end])
                || (joins(characters[end]) && characters.get(end + 1).is_some_and(|c| digit(*c))))
        {
            end += 1;
        }
        out.push('\u{2066}');
        out.extend(&characters[at..end]);
        out.push('\u{2069}');
        at = end;
    }
    out
}

/// Text inside an element or an attribute. Moodle looks for fields in the text before it is read as hypertext: a name must
/// not be one.
pub(super) fn escaped(text: &str) -> String {
    harmless(&markup::escaped(text))
}

/// Hypertext that is written already, so that no name within it is taken for a field, and nothing that XML has not.
pub(super) fn harmless(hypertext: &str) -> String {
    let mut out = String::with_capacity(hypertext.len());
    for c in hypertext.chars() {
        match c {
            '{' => out.push_str("&#123;"),
            '}' => out.push_str("&#125;"),
            c => out.push(markup::allowed(c)),
        }
    }
    out
}

/// A unit as people write it.
pub(super) fn unit(symbol: &str) -> String {
    escaped(&symbol.replace("^2", "²").replace('*', "·").replace("deg", "°"))
}

#[cfg(test)]
mod tests {
    use super::isolated;

    #[test]
    fn numbers_stay_whole_in_arabic_script() {
        assert_eq!(isolated("مسألة 3-1: ذراع"), "مسألة \u{2066}3-1\u{2069}: ذراع");
        assert_eq!(isolated("2.5 و 7."), "\u{2066}2.5\u{2069} و \u{2066}7\u{2069}.");
        assert_eq!(isolated("بلا"), "بلا");
    }
}
