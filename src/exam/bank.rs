//! What the question banks have in common: the questions in one language with their figures, and XML.

use super::Variant;
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
    /// What each number of the answer is, as hypertext.
    pub prompts: Vec<String>,
}

impl<'a> Bank<'a> {
    /// The questions of `scene` with their figures; `figures` are the [cards](super::card) of the variants.
    ///
    /// # Errors
    /// Where this build cannot write an SVG of these options.
    pub fn new(
        scene: &Scene,
        language: Language,
        figures: Vec<(&'a Variant, Figure)>,
        options: &Options,
    ) -> Result<Self, RenderError> {
        let words = language.words();
        let title = scene.title.in_language(words.tag).unwrap_or(words.untitled).to_owned();
        let item = |(variant, figure): (&'a Variant, Figure)| {
            let bytes = render::render(&figure, Format::Svg, options)?;
            let asked = &variant.scene.mechanism.asked;
            let prompts = variant
                .answers
                .iter()
                .map(|answer| harmless(&prompt(&variant.scene, &asked[answer.asked], answer.part, language)))
                .collect();
            Ok::<_, RenderError>(Item {
                variant,
                figure: String::from_utf8_lossy(&bytes).into_owned(),
                prompts,
            })
        };
        let items = figures.into_iter().map(item).collect::<Result<_, _>>()?;
        Ok(Self { title, language, items })
    }

    /// The name of a question.
    pub(super) fn name(&self, item: &Item<'_>) -> String {
        format!("{} · {}", self.title, item.variant.name())
    }

    /// The attributes of an element that holds text of this language.
    pub(super) fn direction(&self) -> &'static str {
        if self.language.words().right_to_left { "rtl" } else { "ltr" }
    }
}

/// Text inside an element or an attribute.
pub(super) fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            // Moodle looks for fields in the text before it is read as hypertext: a name must not be one.
            '{' => out.push_str("&#123;"),
            '}' => out.push_str("&#125;"),
            c => out.push(allowed(c)),
        }
    }
    out
}

/// Hypertext that is written already, so that no name within it is taken for a field, and nothing that XML has not.
pub(super) fn harmless(hypertext: &str) -> String {
    let mut out = String::with_capacity(hypertext.len());
    for c in hypertext.chars() {
        match c {
            '{' => out.push_str("&#123;"),
            '}' => out.push_str("&#125;"),
            c => out.push(allowed(c)),
        }
    }
    out
}

/// A character as XML has it: of the controls, blanks; what is no character at all, replaced.
const fn allowed(c: char) -> char {
    match c {
        '\n' | '\t' => c,
        '\u{0}'..='\u{1f}' | '\u{7f}'..='\u{9f}' => ' ',
        '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}

/// A unit as people write it.
pub(super) fn unit(symbol: &str) -> String {
    escaped(&symbol.replace("^2", "²").replace('*', "·").replace("deg", "°"))
}
