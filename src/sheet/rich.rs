//! Formula text: italic quantities, upright units, stacked sub- and superscripts, ticks, set on a base
//! line and measured.
//!
//! A line with a word of Arabic script in it is set from right to left by `bidi.rs`; formulas stay islands
//! that run from left to right.

use kurbo::{Point, Rect, Vec2};

use super::bidi;
use super::figure::{Group, Mark, Pen, Run, Shape, Text};
use super::font::{Face, is_arabic};

/// Size of a sub- or superscript, per size of its base.
const SCRIPT: f64 = 0.7;
/// How far a subscript hangs below the base line.
const DROP: f64 = 0.20;
/// How far a superscript stands above the base line.
const RAISE: f64 = 0.36;

/// A piece of formula text.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Piece {
    /// Characters on the base line.
    Run(String, Face),
    /// A letter with a small arrow over it: a vector.
    Vector(String),
    /// Superscript and subscript, one above the other.
    Scripts { sup: Vec<(String, Face)>, sub: Vec<(String, Face)> },
    /// A tick: known.
    Tick,
    /// A blank of so many em that no line breaks at.
    Gap(f64),
}

/// A sign as a superscript, where there is such a character.
fn raised(sign: char) -> Option<char> {
    const LETTERS: &str = "abcdefghijklmnoprstuvwxyz";
    const RAISED: &str = "ᵃᵇᶜᵈᵉᶠᵍʰⁱʲᵏˡᵐⁿᵒᵖʳˢᵗᵘᵛʷˣʸᶻ";
    const DIGITS: &str = "⁰¹²³⁴⁵⁶⁷⁸⁹";
    match sign {
        '′' | '″' => Some(sign),
        _ => match sign.to_digit(10) {
            Some(digit) => DIGITS.chars().nth(digit as usize),
            None => RAISED.chars().nth(LETTERS.chars().position(|letter| letter == sign)?),
        },
    }
}

/// A digit as a subscript.
fn lowered(sign: char) -> Option<char> {
    "₀₁₂₃₄₅₆₇₈₉".chars().nth(sign.to_digit(10)? as usize)
}

/// A piece in its place in a text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Item {
    pub(super) piece: Piece,
    /// Part of a formula that runs from left to right as a whole, whatever stands around it.
    pub(super) island: bool,
}

/// Formula text, built piece by piece.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Rich {
    items: Vec<Item>,
    /// Runs from left to right although words of Arabic script stand in it.
    left_to_right: bool,
    /// A line of a text that runs from right to left, though no word of Arabic script stands in it.
    right_to_left: bool,
}

/// Formula text set at the origin: base line at y = 0, start at x = 0.
#[derive(Debug, Clone, PartialEq)]
pub struct Line {
    /// The runs of characters.
    pub text: Text,
    /// Ticks and arrows drawn as strokes.
    pub marks: Vec<Mark>,
    /// Advance width.
    pub width: f64,
    /// Box of the ink.
    pub ink: Rect,
}

impl Rich {
    /// Upright text.
    #[must_use]
    pub fn upright(text: impl AsRef<str>) -> Self {
        Self::default().with(text.as_ref(), Face::Upright)
    }

    /// Italic text.
    #[must_use]
    pub fn italic(text: impl AsRef<str>) -> Self {
        Self::default().with(text.as_ref(), Face::Italic)
    }

    /// Bold text.
    #[must_use]
    pub fn bold(text: impl AsRef<str>) -> Self {
        Self::default().with(text.as_ref(), Face::Bold)
    }

    /// A tick.
    #[must_use]
    pub fn tick() -> Self {
        Self::default().push(Piece::Tick)
    }

    /// A letter with an arrow over it.
    #[must_use]
    pub fn vector(letter: &str) -> Self {
        Self::default().push(Piece::Vector(letter.to_owned()))
    }

    /// A text that somebody wrote, in the direction of its first letter.
    #[must_use]
    pub fn written(text: &str, face: Face) -> Self {
        let first = text.chars().find(|c| c.is_alphabetic());
        let left_to_right = first.is_some_and(|c| !is_arabic(c));
        Self { left_to_right, ..Self::default() }.with(text, face)
    }

    fn push(mut self, piece: Piece) -> Self {
        self.items.push(Item { piece, island: false });
        self
    }

    /// Whether a word of Arabic script stands in it: then it is set from right to left.
    #[must_use]
    pub fn is_arabic(&self) -> bool {
        self.items.iter().any(|item| matches!(&item.piece, Piece::Run(_, face) if face.is_arabic()))
    }

    /// The same as one island that runs from left to right, if it is a formula without words.
    #[must_use]
    pub fn island(mut self) -> Self {
        if !self.is_arabic() {
            self.items.iter_mut().for_each(|item| item.island = true);
        }
        self
    }

    /// The same as a sentence among others that run from right to left: one that is nothing but a formula ends with its full
    /// stop on the left, as they do.
    #[must_use]
    pub fn among_right_to_left(&self) -> Self {
        let own = self.clone();
        if self.is_arabic() || self.left_to_right {
            return own;
        }
        let mut formula = own.clone();
        let Some(Item { piece: Piece::Run(text, face), .. }) = formula.items.last_mut() else { return own };
        let (true, face) = (text.ends_with('.'), *face) else { return own };
        text.pop();
        let text = formula.island().with_item(".", face, false);
        Self { right_to_left: true, ..text }
    }

    /// The same with a word after it, and no line breaks between.
    #[must_use]
    pub fn word(self, word: &str) -> Self {
        self.aside("\u{a0}", &Self::upright(word))
    }

    /// The same with a separator and words after it: a formula before words of Arabic script is an island.
    #[must_use]
    pub fn aside(self, separator: &str, words: &Self) -> Self {
        let before = if words.is_arabic() { self.island() } else { self };
        before.up(separator).then(words)
    }

    /// Whether nothing is in it.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.items.is_empty()
    }

    /// The same with characters after it. A character that the face lacks is set upright, Arabic script in
    /// its own face.
    #[must_use]
    pub fn with(self, text: &str, face: Face) -> Self {
        self.with_item(text, face, false)
    }

    fn with_item(mut self, text: &str, face: Face, island: bool) -> Self {
        let mut own = match self.items.last() {
            Some(Item { piece: Piece::Run(_, face), island: same }) if *same == island => Some(*face),
            _ => None,
        };
        // Letters of one face, as most are, together.
        let mut from = 0;
        for (at, c) in text.char_indices() {
            let face = of_script(face, c);
            // A blank never needs a run of its own.
            if own.is_some_and(|own| own == face || c == ' ') {
                continue;
            }
            self.lengthen(&text[from..at]);
            self.items.push(Item { piece: Piece::Run(String::new(), face), island });
            (own, from) = (Some(face), at);
        }
        self.lengthen(&text[from..]);
        self
    }

    /// Adds to the last run of letters.
    fn lengthen(&mut self, text: &str) {
        if let Some(Item { piece: Piece::Run(run, _), .. }) = self.items.last_mut() {
            run.push_str(text);
        }
    }

    /// The same with more text after it.
    #[must_use]
    pub fn then(mut self, more: &Self) -> Self {
        for item in &more.items {
            match &item.piece {
                Piece::Run(text, face) => self = self.with_item(text, *face, item.island),
                _ => self.items.push(item.clone()),
            }
        }
        self
    }

    /// The same with upright text after it.
    #[must_use]
    pub fn up(self, text: &str) -> Self {
        self.with(text, Face::Upright)
    }

    /// The same with italic text after it.
    #[must_use]
    pub fn it(self, text: &str) -> Self {
        self.with(text, Face::Italic)
    }

    /// The same with a blank of so many em, at which no line breaks.
    #[must_use]
    pub fn gap(self, em: f64) -> Self {
        self.push(Piece::Gap(em))
    }

    /// The same with an upright subscript.
    #[must_use]
    pub fn sub(self, text: &str) -> Self {
        self.scripts("", Face::Upright, text)
    }

    /// The same with an upright superscript.
    #[must_use]
    pub fn sup(self, text: &str) -> Self {
        self.scripts(text, Face::Upright, "")
    }

    /// The same with a superscript over an upright subscript.
    #[must_use]
    pub fn scripts(self, sup: &str, sup_face: Face, sub: &str) -> Self {
        let part = |text: &str, face| {
            if text.is_empty() { Vec::new() } else { vec![(text.to_owned(), face)] }
        };
        if sup.is_empty() && sub.is_empty() {
            return self;
        }
        self.push(Piece::Scripts { sup: part(sup, sup_face), sub: part(sub, Face::Upright) })
    }

    /// Fills the named places (`{vector}`) of a template of words.
    #[must_use]
    pub fn fill(template: &str, parts: &[(&str, Self)]) -> Self {
        let islands = template.chars().any(is_arabic);
        // What stands between two places without a word is a sign of the formula of which both are parts.
        let sign = |text: &str| {
            let signs = "=·×/+−≡ \u{a0}";
            !text.trim().is_empty() && text.chars().all(|c| signs.contains(c))
        };
        let mut out = Self::default();
        let mut rest = template;
        while let Some(open) = rest.find('{') {
            let between = &rest[..open];
            let inside = islands && !out.is_empty() && sign(between);
            out = if inside { out.with_item(between, Face::Upright, true) } else { out.up(between) };
            let Some(length) = rest[open..].find('}') else { break };
            let name = &rest[open + 1..open + length];
            if let Some((_, part)) = parts.iter().find(|(n, _)| *n == name) {
                out = if islands { out.then(&part.clone().island()) } else { out.then(part) };
            }
            rest = &rest[open + length + 1..];
        }
        out.up(rest)
    }

    /// The same for a page of hypertext: subscripts, superscripts and italics as elements. Ticks and gaps, which
    /// no symbol of a quantity has, are left out.
    #[must_use]
    pub fn html(&self) -> String {
        let run = |text: &str, face: Face| {
            let text = text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
            if face == Face::Italic { format!("<i>{text}</i>") } else { text }
        };
        let runs = |name: &str, runs: &[(String, Face)]| match runs {
            [] => String::new(),
            runs => {
                let inside: String = runs.iter().map(|(text, face)| run(text, *face)).collect();
                format!("<{name}>{inside}</{name}>")
            }
        };
        let piece = |item: &Item| match &item.piece {
            Piece::Run(text, face) => run(text, *face),
            Piece::Vector(letter) => run(letter, Face::Italic),
            Piece::Scripts { sup, sub } => runs("sup", sup) + &runs("sub", sub),
            Piece::Tick | Piece::Gap(_) => String::new(),
        };
        let is_arabic = |item: &&Item| match &item.piece {
            Piece::Run(text, _) => text.chars().any(super::font::is_arabic),
            Piece::Scripts { sup, sub } => {
                sup.iter().chain(sub).any(|(text, _)| text.chars().any(super::font::is_arabic))
            }
            _ => false,
        };
        // A formula with names of Arabic script is an isolate from left to right.
        let part = |items: &[Item]| {
            let inside: String = items.iter().map(piece).collect();
            let isolated = items[0].island && items.iter().any(|item| is_arabic(&item));
            if isolated { format!("\u{2066}{inside}\u{2069}") } else { inside }
        };
        self.items.chunk_by(|a, b| a.island == b.island).map(part).collect()
    }

    /// The text as plain characters: V_B, ω₃, Aⁿ_BA.
    #[must_use]
    pub fn plain(&self) -> String {
        let runs = |runs: &[(String, Face)]| runs.iter().map(|(text, _)| text.as_str()).collect::<String>();
        let raised = |text: &str| -> String {
            let signs: Option<String> = text.chars().map(raised).collect();
            signs.unwrap_or_else(|| if text.is_empty() { String::new() } else { format!("^{text}") })
        };
        let lowered = |text: &str| -> String {
            let signs: Option<String> = text.chars().map(lowered).collect();
            signs.unwrap_or_else(|| format!("_{text}"))
        };
        let piece = |item: &Item| match &item.piece {
            Piece::Run(text, _) => text.clone(),
            Piece::Vector(letter) => letter.clone(),
            Piece::Scripts { sup, sub } => raised(&runs(sup)) + &lowered(&runs(sub)),
            Piece::Tick | Piece::Gap(_) => String::new(),
        };
        self.items.iter().map(piece).collect()
    }

    /// The same squared: the 2 stands over the last subscript.
    #[must_use]
    pub fn squared(mut self) -> Self {
        match self.items.last_mut().map(|item| &mut item.piece) {
            Some(Piece::Scripts { sup, .. }) if sup.is_empty() => sup.push(("2".to_owned(), Face::Upright)),
            _ => return self.sup("2"),
        }
        self
    }

    /// The same with its upright characters bold.
    #[must_use]
    pub fn bolder(mut self) -> Self {
        for item in &mut self.items {
            match &mut item.piece {
                Piece::Run(_, face @ Face::Upright) => *face = Face::Bold,
                Piece::Run(_, face @ Face::Arabic) => *face = Face::ArabicBold,
                _ => {}
            }
        }
        self
    }

    /// Joins texts with a separator.
    #[must_use]
    pub fn join(parts: &[Self], separator: &Self) -> Self {
        let islands = separator.is_arabic();
        let mut out = Self::default();
        for (i, part) in parts.iter().enumerate() {
            if i > 0 {
                out = out.then(separator);
            }
            out = if islands { out.then(&part.clone().island()) } else { out.then(part) };
        }
        out
    }

    /// Sets the text at `size` mm.
    #[must_use]
    pub fn set(&self, size: f64) -> Line {
        self.run_through(size).finish()
    }

    fn run_through(&self, size: f64) -> Setter {
        if self.is_arabic() || self.right_to_left {
            return bidi::set(&self.items, !self.left_to_right, size);
        }
        let mut setter = Setter::new(size);
        for item in &self.items {
            setter.piece(&item.piece);
        }
        setter
    }

    /// Advance width at `size` mm.
    #[must_use]
    pub fn width(&self, size: f64) -> f64 {
        if self.is_arabic() || self.right_to_left {
            return self.run_through(size).pen;
        }
        let mut setter = Setter::measuring(size);
        for item in &self.items {
            setter.piece(&item.piece);
        }
        setter.pen
    }

    /// Advance width of a line to which words are added: what stands before its last piece, to which they are, is measured
    /// once.
    fn width_after(&self, before: &mut Before) -> f64 {
        let Before { setter, pieces } = before;
        if self.is_arabic() || self.right_to_left {
            return self.width(setter.size);
        }
        let Some((last, others)) = self.items.split_last() else { return 0.0 };
        for item in others.iter().skip(*pieces) {
            setter.piece(&item.piece);
            *pieces += 1;
        }
        let mut setter = setter.clone();
        setter.piece(&last.piece);
        setter.pen
    }

    /// Where it ends: how many pieces it has, and how long the last one is, where it is one of letters.
    fn end(&self) -> (usize, usize) {
        let last = match self.items.last() {
            Some(Item { piece: Piece::Run(run, _), .. }) => run.len(),
            _ => 0,
        };
        (self.items.len(), last)
    }

    /// Takes away what was added since it ended there.
    fn cut_back(&mut self, (pieces, last): (usize, usize)) {
        self.items.truncate(pieces);
        if let Some(Item { piece: Piece::Run(run, _), .. }) = self.items.last_mut() {
            run.truncate(last);
        }
    }

    /// The words between which a line may break.
    fn words(&self) -> Vec<Self> {
        let mut words = vec![Self::default()];
        for item in &self.items {
            if let Piece::Run(text, face) = &item.piece {
                for (i, part) in text.split(' ').enumerate() {
                    if i > 0 {
                        words.push(Self::default());
                    }
                    if let Some(last) = words.pop() {
                        words.push(last.with_item(part, *face, item.island));
                    }
                }
            } else if let Some(last) = words.last_mut() {
                last.items.push(item.clone());
            }
        }
        words.retain(|w| !w.is_empty());
        words
    }

    /// A word too long for any line, cut where it has no formula in it: before a sign of equality, before another sign, at
    /// any other blank that holds it together, and only then between its characters.
    fn cut(&self, size: f64, width: f64) -> Vec<Self> {
        let [Item { piece: Piece::Run(text, face), .. }] = &self.items[..] else { return vec![self.clone()] };
        if face.advance(text, size) <= width {
            return vec![self.clone()];
        }
        const HOLDS: char = '\u{a0}';
        let before = |sign: char| -> Vec<&str> {
            let mut parts = Vec::new();
            let mut begin = 0;
            for (at, _) in text.match_indices(HOLDS).filter(|(at, _)| {
                let after = &text[at + HOLDS.len_utf8()..];
                after.starts_with(sign)
            }) {
                parts.push(&text[begin..at]);
                begin = at + HOLDS.len_utf8();
            }
            parts.push(&text[begin..]);
            parts
        };
        let fits = |parts: &[&str]| parts.iter().all(|part| face.advance(part, size) <= width);
        let ways = [before('='), before('×'), text.split(HOLDS).collect()];
        if let Some(parts) = ways.into_iter().find(|parts| parts.len() > 1 && fits(parts)) {
            return parts.into_iter().map(|part| Self::default().with(part, *face)).collect();
        }
        let mut parts = vec![String::new()];
        for c in text.chars() {
            let full =
                parts.last().is_some_and(|p| !p.is_empty() && face.advance(&format!("{p}{c}"), size) > width);
            if full {
                parts.push(String::new());
            }
            if let Some(last) = parts.last_mut() {
                last.push(c);
            }
        }
        parts.into_iter().map(|part| Self::default().with(&part, *face)).collect()
    }

    /// Breaks the text into lines no wider than `width`, where its words allow.
    #[must_use]
    pub fn wrap(&self, size: f64, width: f64) -> Vec<Self> {
        let mut lines: Vec<Self> = Vec::new();
        let mut line = Self::default();
        // A line of an Arabic text is set like the whole, also where only a formula stands in it.
        let right_to_left = !self.left_to_right && (self.right_to_left || self.is_arabic());
        let mut words = self.words();
        if right_to_left {
            words = with_their_signs(words);
        }
        let mut before = Before::new(size);
        for word in words.iter().flat_map(|word| word.cut(size, width)) {
            if line.is_empty() {
                line = word;
                continue;
            }
            let own = line.end();
            line = line.then_word(&word);
            if line.width_after(&mut before) <= width {
                continue;
            }
            line.cut_back(own);
            // A line does not end with a sign of equality: it stands before what it gives, in the same island.
            let signed = || {
                let signed = Self::default().with_item("=\u{a0}", Face::Upright, right_to_left).then(&word);
                (signed.width(size) <= width).then_some(signed)
            };
            let word = match line.without_equals().and_then(|bare| Some((bare, signed()?))) {
                Some((bare, signed)) => {
                    line = bare;
                    signed
                }
                None => word,
            };
            lines.push(std::mem::replace(&mut line, word));
            before = Before::new(size);
        }
        if !line.is_empty() {
            lines.push(line);
        }
        for line in &mut lines {
            line.left_to_right = self.left_to_right;
            line.right_to_left = right_to_left;
        }
        lines
    }

    /// The text without the sign of equality at its end; none where it has none, or nothing else.
    fn without_equals(&self) -> Option<Self> {
        const BLANKS: [char; 2] = [' ', '\u{a0}'];
        let mut own = self.clone();
        let Some(Item { piece: Piece::Run(text, _), .. }) = own.items.last_mut() else { return None };
        let before = text.strip_suffix('=')?;
        let bare = before.trim_end_matches(BLANKS).to_owned();
        // A sign that stands close behind its symbol stays there.
        if bare.len() == before.len() && !bare.is_empty() {
            return None;
        }
        *text = bare;
        if text.is_empty() {
            own.items.pop();
        }
        (!own.is_empty()).then_some(own)
    }

    /// The same with a blank and a word after it; a blank within an island belongs to the island.
    fn then_word(self, word: &Self) -> Self {
        let island = |item: Option<&Item>| item.is_some_and(|item| item.island);
        let inside = island(self.items.last()) && island(word.items.first());
        self.with_item(" ", Face::Upright, inside).then(word)
    }
}

/// The words of a text that runs from right to left, the signs of its formulas with what follows them: a formula's line would
/// end with a sign beside the word before the formula.
fn with_their_signs(words: Vec<Rich>) -> Vec<Rich> {
    let is_sign = |word: &Rich| {
        let inside = word.items.iter().all(|item| item.island);
        inside && matches!(word.plain().trim_matches('\u{a0}'), "=" | "·" | "×" | "/" | "+" | "−" | "≡")
    };
    let mut all: Vec<Rich> = Vec::new();
    let mut sign: Option<Rich> = None;
    for word in words {
        let word = match sign.take() {
            Some(sign) => sign.with_item("\u{a0}", Face::Upright, true).then(&word),
            None => word,
        };
        if is_sign(&word) { sign = Some(word) } else { all.push(word) }
    }
    all.extend(sign);
    all
}

/// The face in which a character stands in a text of this face.
fn of_script(face: Face, c: char) -> Face {
    let bold = matches!(face, Face::Bold | Face::ArabicBold);
    match (is_arabic(c), face.is_arabic()) {
        (true, _) => {
            if bold {
                Face::ArabicBold
            } else {
                Face::Arabic
            }
        }
        (false, true) if c == ' ' => face,
        (false, true) => {
            if bold {
                Face::Bold
            } else {
                Face::Upright
            }
        }
        (false, false) if c == ' ' || face.has(c) => face,
        (false, false) => Face::Upright,
    }
}

impl Line {
    /// Adds the line to a group with the start of its base line at `at`.
    pub fn put(&self, group: &mut Group, at: Point, class: &'static str) {
        let mut own = Group::default();
        own.text(Text { class, runs: self.text.runs.clone() });
        own.children.extend(self.marks.iter().cloned().map(super::figure::Node::Mark));
        own.translate(at.to_vec2());
        group.children.append(&mut own.children);
    }

    /// The box of the ink when set at `at`.
    #[must_use]
    pub fn ink_at(&self, at: Point) -> Rect {
        self.ink + at.to_vec2()
    }

    /// The boxes of runs and marks when set at `at`: tighter than the one box.
    #[must_use]
    pub fn boxes_at(&self, at: Point) -> Vec<Rect> {
        let by: Vec2 = at.to_vec2();
        let marks = self.marks.iter().map(Mark::bounds);
        self.text.boxes().into_iter().chain(marks).map(|r| r + by).collect()
    }
}

/// What stands before the last piece of a line that grows.
struct Before {
    setter: Setter,
    /// How many pieces that are.
    pieces: usize,
}

impl Before {
    fn new(size: f64) -> Self {
        Self { setter: Setter::measuring(size), pieces: 0 }
    }
}

/// A line while it is being set.
#[derive(Clone)]
pub(super) struct Setter {
    pub(super) size: f64,
    pub(super) pen: f64,
    pub(super) runs: Vec<Run>,
    pub(super) marks: Vec<Mark>,
    /// Nothing is wanted but where the pen ends.
    measures: bool,
    /// The last letter, and its face.
    last: Option<(char, Face)>,
}

impl Setter {
    pub(super) fn new(size: f64) -> Self {
        Self { size, pen: 0.0, runs: Vec::new(), marks: Vec::new(), measures: false, last: None }
    }

    /// Without runs and the boxes of their ink, which cost far more than the advance.
    fn measuring(size: f64) -> Self {
        Self { measures: true, ..Self::new(size) }
    }

    /// Sets characters at height `y`; returns where the pen ends. Leading blanks move the pen and go to
    /// the end of the run before: some viewers drop a blank at the start of a run.
    fn run(&mut self, text: &str, face: Face, size: f64, x: f64, y: f64) -> f64 {
        self.last = text.chars().last().map(|letter| (letter, face)).or(self.last);
        if self.measures {
            return x + face.advance(text, size);
        }
        let trimmed = text.trim_start_matches(' ');
        let blank = face.advance(&text[..text.len() - trimmed.len()], size);
        if blank > 0.0
            && let Some(last) = self.runs.last_mut()
            && !last.text.ends_with(' ')
        {
            last.text.push(' ');
        }
        if !trimmed.is_empty() {
            self.runs.push(Run { text: trimmed.to_owned(), face, size, at: Point::new(x + blank, y) });
        }
        x + face.advance(text, size)
    }

    /// How far the last letter leans over its own width at the height of a prime, in its size: an f runs into what
    /// follows.
    fn lean(&self) -> f64 {
        /// Letters that lean less leave room for a prime.
        const LEAST: f64 = 0.1;
        let last = self.last.map(|(letter, face)| (letter.to_string(), face));
        let lean = last.and_then(|(text, face)| Some(face.ink(&text, 1.0)?.x1 - face.advance(&text, 1.0)));
        lean.filter(|lean| *lean > LEAST).unwrap_or(0.0)
    }

    pub(super) fn piece(&mut self, piece: &Piece) {
        let em = self.size;
        match piece {
            Piece::Run(text, face) => self.pen = self.run(text, *face, em, self.pen, 0.0),
            Piece::Gap(width) => self.pen += width * em,
            Piece::Vector(letter) => {
                let start = self.pen;
                self.pen = self.run(letter, Face::Italic, em, start, 0.0);
                if let Some(ink) = Face::Italic.ink(letter, em).filter(|_| !self.measures) {
                    let y = ink.y0 - 0.17 * em;
                    let (x0, x1) = (start + ink.x0 + 0.06 * em, start + ink.x1 + 0.06 * em);
                    let tip = Point::new(x1, y);
                    let barb = |dy: f64| Point::new(x1 - 0.14 * em, y + dy * em);
                    let pen = Pen::solid(0.035 * em);
                    let shaft = Shape::Line(Point::new(x0, y), tip);
                    self.marks.push(Mark::stroke(shaft, pen).class("arrow-over"));
                    let head = Shape::Polyline(vec![barb(-0.07), tip, barb(0.07)]);
                    self.marks.push(Mark::stroke(head, pen).class("arrow-over"));
                }
            }
            Piece::Scripts { sup, sub } => {
                let start = self.pen;
                let small = SCRIPT * em;
                let mut end = start;
                // A superscript stands beside the hook of an f, not in it.
                let mut x = start + (0.04 + self.lean()) * em;
                for (text, face) in sup {
                    // Primes are raised in the font itself.
                    let prime = text.chars().all(|c| c == '′' || c == '″');
                    x = if prime {
                        self.run(text, *face, em, x - 0.09 * em, 0.0)
                    } else {
                        self.run(text, *face, small, x, -RAISE * em)
                    };
                }
                end = end.max(if sup.is_empty() { start } else { x });
                let mut x = start + 0.01 * em;
                for (text, face) in sub {
                    x = self.run(text, *face, small, x, DROP * em);
                }
                self.pen = end.max(if sub.is_empty() { start } else { x + 0.02 * em });
            }
            Piece::Tick => {
                let x = self.pen + 0.08 * em;
                let at = |dx: f64, dy: f64| Point::new(x + dx * em, -dy * em);
                let shape = Shape::Polyline(vec![at(0.0, 0.26), at(0.16, 0.02), at(0.50, 0.62)]);
                self.marks.push(Mark::stroke(shape, Pen::solid(0.07 * em)).class("tick"));
                self.pen += 0.66 * em;
            }
        }
    }

    fn finish(self) -> Line {
        let text = Text { class: "", runs: self.runs };
        let ink = text.bounds().into_iter().chain(self.marks.iter().map(Mark::bounds));
        let ink = ink.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        Line { text, marks: self.marks, width: self.pen, ink }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_prime_stands_clear_of_a_letter_that_leans() {
        let room = |letter: &str| {
            let line = Rich::italic(letter).scripts("′", Face::Italic, "").set(10.0);
            let [letter, prime] = &line.text.runs[..] else { panic!("{line:?}") };
            let ink = |run: &Run| run.face.ink(&run.text, run.size).unwrap() + run.at.to_vec2();
            ink(prime).x0 - ink(letter).x1
        };
        for upright in ["a", "b", "o"] {
            assert!(room("f") > room(upright) - 0.1, "{} {upright} {}", room("f"), room(upright));
        }
    }

    #[test]
    fn scripts_stand_one_above_the_other() {
        let line = Rich::italic("A").scripts("n", Face::Upright, "BA").set(10.0);
        let [_, n, ba] = &line.text.runs[..] else { panic!("{line:?}") };
        assert!((n.at.x - ba.at.x).abs() < 0.5 && n.at.y < 0.0 && ba.at.y > 0.0);
        assert_eq!(line.text.content(), "AnBA");
    }

    #[test]
    fn a_superscript_keeps_clear_of_an_f() {
        let line = Rich::italic("f").scripts("n", Face::Upright, "b").set(10.0);
        let [f, n, _] = &line.text.runs[..] else { panic!("{line:?}") };
        let hook = Face::Italic.ink("f", 10.0).unwrap().x1;
        assert!(n.at.x - f.at.x >= hook, "{} {hook}", n.at.x - f.at.x);
    }

    #[test]
    fn lines_break_at_blanks_and_stay_inside() {
        let text = Rich::fill(
            "From {o} lay off {v} and draw a line",
            &[("o", Rich::italic("o")), ("v", Rich::italic("V").sub("A"))],
        );
        let lines = text.wrap(3.5, 24.0);
        assert!(lines.len() > 1);
        let mut words = String::new();
        for line in &lines {
            let set = line.set(3.5);
            assert!(set.width <= 24.0);
            words.push_str(&set.text.content());
            words.push(' ');
        }
        assert_eq!(words.trim(), "From o lay off VA and draw a line");
    }

    #[test]
    fn no_line_ends_with_a_sign_of_equality() {
        let text = Rich::italic("x").sub("1").up("\u{a0}= 38.57\u{a0}mm, ").it("T").up("\u{a0}= 15\u{a0}N·m");
        let text = text.then(&Rich::fill(" as {v} = 72.3\u{a0}mm", &[("v", Rich::italic("V").sub("(24)"))]));
        // Where a line can hold the sign with what it gives.
        let least = Rich::upright("=\u{a0}38.57\u{a0}mm,").width(3.5);
        for width in 0..50 {
            let lines = text.wrap(3.5, least + f64::from(width));
            let ends = lines.iter().filter(|line| line.plain().ends_with('='));
            assert_eq!(ends.count(), 0, "{width}: {lines:?}");
        }
    }

    #[test]
    fn nor_does_one_that_runs_from_right_to_left() {
        let formula = Rich::italic("e").up("\u{a0}= 731.5 × 21.67 / 884.4\u{a0}= ").up("17.92\u{a0}cm");
        let text = Rich::fill("عزوم الوصلة حول {p}", &[("p", Rich::italic("O").up(": ").then(&formula))]);
        assert!(text.is_arabic());
        let least = Rich::upright("=\u{a0}17.92\u{a0}cm").width(3.5);
        let mut broken = 0;
        for width in 0..80 {
            let lines = text.wrap(3.5, least + f64::from(width));
            let ends = lines.iter().filter(|line| line.plain().trim_end().ends_with('='));
            assert_eq!(ends.count(), 0, "{width}: {lines:?}");
            broken += lines.iter().filter(|line| line.plain().starts_with('=')).count();
        }
        assert!(broken > 0);
    }

    #[test]
    fn a_word_without_end_is_cut() {
        let lines = Rich::upright("x".repeat(500)).wrap(3.5, 40.0);
        assert!(lines.len() > 5 && lines.iter().all(|line| line.width(3.5) <= 40.0));
    }

    #[test]
    fn what_italics_lack_is_set_upright() {
        let line = Rich::italic("a⊥b").set(4.0);
        assert!(line.text.runs.iter().any(|r| r.text == "⊥" && r.face == Face::Upright));
    }
}
