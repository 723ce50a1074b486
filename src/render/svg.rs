//! A figure as SVG 1.1: millimetres, real text, no scripts, nothing from outside.
//!
//! What a reader of the file may rely on: coordinates are millimetres of the page, y down, without
//! transforms. A `vector` group holds a `shaft`, whose first point is the vector's tail, and a `head`,
//! whose first point is its tip; `data-quantity`, `data-value` (in the unit of its polygon's `data-unit`),
//! `data-from`, `data-to` and, where a direction is claimed, `data-parallel` or `data-perpendicular` (two
//! points, or `guide` and the name that a group of the skeleton carries as `data-guide`: its rider, and its
//! link where one pin rides on several; the first stroke of that group has the guide's direction). A vector
//! too short to draw is a circle with `data-as-point`. The polygon's and the skeleton's `data-scale` is its
//! unit per millimetre (`data-si-per-mm` the same in SI); images and joints carry `data-point`, which no two
//! places of a figure share.
//!
//! Title and description are the first children and name the picture for screen readers. Identifiers begin
//! with a hash of the content, so that several figures can stand in one HTML page.

use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kurbo::{PathEl, Point};

use super::number::{decimal, push_decimal};
use super::subset;
use super::theme::{Place, Theme};
use crate::parallel;
use crate::sheet::figure::{Figure, Group, Mark, Node, Pen, Run, Shape, Text, Tone, on_circle};
use crate::sheet::font::{ARABIC_FAMILIES, ARABIC_FAMILY, FAMILIES, FAMILY, Face, Used};

/// Decimals of a millimetre for ink that only has to look right.
const LAYOUT: usize = 3;
/// Decimals of a millimetre for ink whose length is a quantity.
const PRECISE: usize = 6;

/// The class of words in Arabic script, where the file says once what family they have.
pub const ARABIC_CLASS: &str = "arabic";

/// Stands for what every identifier begins with, until the content is known; no text has it (see [`printed`]).
const PREFIX: char = '\u{1}';

/// The figure as an SVG document, black on white.
#[must_use]
pub fn write(figure: &Figure) -> String {
    write_in(figure, Theme::Mono)
}

/// The figure as an SVG document in the colours of a theme.
#[must_use]
pub fn write_in(figure: &Figure, theme: Theme) -> String {
    document(figure, theme, &Lettered::Live, None)
}

/// The same with the typefaces that its text is set in embedded as `data:`, with the glyphs that occur, so that it looks
/// alike where they are not installed: some 10 kB for each typeface, 45 kB for one of Arabic script.
#[must_use]
pub fn write_embedded(figure: &Figure, theme: Theme) -> String {
    document(figure, theme, &Lettered::Embedded, Some(font_faces(figure)))
}

/// A part of a figure as SVG, to stand in a document of somebody else; its identifiers as they are.
#[must_use]
pub fn fragment(group: &Group) -> String {
    let mut writer = Writer::new(Theme::Mono, &Lettered::Live);
    writer.group(group, Place::default());
    writer.out.replace(PREFIX, "")
}

/// The rules for the typefaces of the text of some figures, with the glyphs that occur and some more characters of each.
#[must_use]
pub fn faces(figures: &[&Figure], also: &str) -> String {
    let Some((first, others)) = figures.split_first() else { return String::new() };
    let mut all = (*first).clone();
    all.root.children.extend(others.iter().flat_map(|other| other.root.children.clone()));
    for face in [Face::Upright, Face::Italic] {
        let at = Point::ORIGIN;
        let runs = vec![Run { text: also.to_owned(), face, size: 4.0, at }];
        all.root.children.push(Node::Text(Text { class: "", runs }));
    }
    let rules = font_faces(&all);
    rules.trim_start_matches("<style>").trim_end_matches("</style>").to_owned()
}

/// Path data of each line of text by its identifier, as [`write_numbered`] gives them.
#[cfg(feature = "png")]
pub(super) type Outlines = std::collections::BTreeMap<String, String>;

/// The figure with an identifier at each line of text, for [`write_outlined`].
#[cfg(feature = "png")]
pub(super) fn write_numbered(figure: &Figure) -> String {
    document(figure, Theme::Mono, &Lettered::Numbered, None)
}

/// The figure with paths in the place of its text.
#[cfg(feature = "png")]
pub(super) fn write_outlined(figure: &Figure, theme: Theme, outlines: Outlines) -> String {
    document(figure, theme, &Lettered::Outlined(outlines), None)
}

/// How text is written.
enum Lettered {
    Live,
    Embedded,
    #[cfg(feature = "png")]
    Numbered,
    #[cfg(feature = "png")]
    Outlined(Outlines),
}

fn document(figure: &Figure, theme: Theme, lettered: &Lettered, style: Option<String>) -> String {
    let mut writer = Writer::new(theme, lettered);
    writer.group(&figure.root, Place::default());
    let body = writer.out;
    // The hash is of all that stands in the figure but the prefix itself.
    let said = figure.title.bytes().chain([b'\n']).chain(figure.description.bytes()).chain([b'\n']);
    let drawn = body.split(PREFIX).flat_map(str::bytes);
    let prefix = format!("f{:08x}-", fold(fnv_of(said.chain(drawn))));
    let (title, description) = (format!("{prefix}title"), format!("{prefix}desc"));
    let described = !figure.description.is_empty();
    let labels = if described { format!("{title} {description}") } else { title.clone() };
    let width = decimal(figure.width, LAYOUT);
    let height = decimal(figure.height, LAYOUT);
    let paints = theme.paints_paper();

    let rest = style.as_ref().map_or(0, String::len) + figure.title.len() + figure.description.len();
    let mut writer =
        Writer { out: String::with_capacity(body.len() + rest + 2048), ..Writer::new(theme, lettered) };
    writer.open("svg");
    writer.attribute("aria-labelledby", &labels);
    if paints {
        writer.colour("fill", Tone::Ink, Place::default());
    }
    writer.attribute("font-family", FAMILIES);
    writer.attribute("height", &format!("{height}mm"));
    writer.attribute("lang", figure.language);
    writer.attribute("role", "img");
    writer.attribute("stroke-linejoin", "round");
    writer.attribute("viewBox", &format!("0 0 {width} {height}"));
    writer.attribute("width", &format!("{width}mm"));
    writer.attribute("xml:lang", figure.language);
    writer.attribute("xmlns", "http://www.w3.org/2000/svg");
    writer.out.push_str(">\n");
    writer.element_with_text("title", Some(&title), &figure.title);
    if described {
        writer.out.push('\n');
        writer.element_with_text("desc", Some(&description), &figure.description);
    }
    if let Some(style) = style {
        writer.out.push('\n');
        writer.out.push_str(&style);
    }
    if paints {
        writer.out.push('\n');
        writer.open("rect");
        writer.attribute("class", "paper");
        writer.colour("fill", Tone::Paper, Place::default());
        writer.attribute("height", &height);
        writer.attribute("width", &width);
        writer.out.push_str("/>");
    }
    writer.out.push('\n');
    for (i, part) in body.split(PREFIX).enumerate() {
        if i > 0 {
            writer.out.push_str(&prefix);
        }
        writer.out.push_str(part);
    }
    writer.out.push_str("\n</svg>\n");
    writer.out
}

/// The FNV-1a hash: short, and the same everywhere.
pub(crate) fn fnv(bytes: &[u8]) -> u64 {
    fnv_of(bytes.iter().copied())
}

fn fnv_of(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01b3))
}

/// Seconds for which a step of a film is shown.
const SECONDS: usize = 3;

/// The frames of a film as one figure, the last one on top; to be written, and then [`play`]ed.
pub(super) fn film(frames: &[Figure]) -> Option<Figure> {
    let mut root = Group::new("film");
    for (i, frame) in frames.iter().enumerate() {
        let mut group = frame.root.clone();
        group.class = format!("frame f{i}");
        root.group(group);
    }
    Some(Figure { root, ..frames.last()?.clone() })
}

/// The document of a [`film`] of so many frames, with what lets the viewer itself play it.
pub(super) fn play(svg: &str, count: usize) -> String {
    let mut style = String::new();
    for i in 0..count {
        let percent = |k: usize| decimal(100.0 * k as f64 / count as f64, LAYOUT);
        let from = if i == 0 { String::new() } else { "0%{visibility:hidden}".to_owned() };
        let (begin, end) = (percent(i), percent(i + 1));
        let to = if i + 1 == count { String::new() } else { format!("{end}%,100%{{visibility:hidden}}") };
        style.push_str(&format!("@keyframes k{i}{{{from}{begin}%{{visibility:visible}}{to}}}"));
        let whole = SECONDS * count;
        style.push_str(&format!(".f{i}{{animation:k{i} {whole}s step-end 1 both}}"));
    }
    style.push_str(
        "@media print{.frame{animation:none}}@media (prefers-reduced-motion){.frame{animation:none}}",
    );
    // What is hidden until it is played is hidden by an attribute, over which the animation wins.
    let mut hidden = svg.to_owned();
    for i in 0..count.saturating_sub(1) {
        let class = format!("class=\"frame f{i}\"");
        hidden = hidden.replacen(&class, &format!("{class} visibility=\"hidden\""), 1);
    }
    hidden.replacen("<g class=\"film\">", &format!("<style>{style}</style>\n<g class=\"film\">"), 1)
}

fn fold(hash: u64) -> u32 {
    (hash ^ (hash >> 32)) as u32
}

/// One `@font-face` for each typeface that occurs, with the glyphs that occur; and the family of Arabic script, which
/// would else stand at every word.
fn font_faces(figure: &Figure) -> String {
    let mut used: BTreeMap<Face, Used> = BTreeMap::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            for run in &text.runs {
                // The substitutions of Arabic script weigh as much as all else: its titles are thickened by the viewer.
                let face = if run.face.is_arabic() { Face::Arabic } else { run.face };
                used.entry(face).or_default().add(face, &run.text.chars().map(printed).collect::<String>());
            }
        }
    });
    let mut rules = String::from("<style>");
    if used.keys().any(|face| face.is_arabic()) {
        rules.push_str(&format!(".{ARABIC_CLASS}{{font-family:{ARABIC_FAMILIES}}}"));
    }
    let used: Vec<(Face, Used)> = used.into_iter().collect();
    // To cut a typeface down takes longer than to write the figure.
    let rule = |(face, used): &(Face, Used)| {
        let (family, style, weight) = match face {
            Face::Upright => (FAMILY, "normal", "normal"),
            Face::Italic => (FAMILY, "italic", "normal"),
            Face::Bold => (FAMILY, "normal", "bold"),
            Face::Arabic | Face::ArabicBold => (ARABIC_FAMILY, "normal", "normal"),
        };
        let (data, format) = match subset::woff(*face, used) {
            Some(data) => (STANDARD.encode(data), "woff"),
            None => (STANDARD.encode(face.bytes()), "opentype"),
        };
        format!(
            "@font-face{{font-family:'{family}';font-style:{style};font-weight:{weight};\
             src:url(data:font/{format};base64,{data}) format('{format}')}}",
        )
    };
    rules.extend(parallel::map(&used, rule));
    rules.push_str("</style>");
    rules
}

/// Writes elements as it goes, attributes in the order of their names: a tree of them would take ten times the room of the
/// document.
struct Writer<'a> {
    theme: Theme,
    lettered: &'a Lettered,
    /// Lines of text written so far.
    texts: usize,
    out: String,
}

impl<'a> Writer<'a> {
    const fn new(theme: Theme, lettered: &'a Lettered) -> Self {
        Self { theme, lettered, texts: 0, out: String::new() }
    }

    /// Begins an element.
    fn open(&mut self, name: &str) {
        self.out.push('<');
        self.out.push_str(name);
    }

    fn attribute(&mut self, name: &str, value: &str) {
        self.begin_attribute(name);
        self.value(value);
        self.out.push('"');
    }

    fn begin_attribute(&mut self, name: &str) {
        self.out.push(' ');
        self.out.push_str(name);
        self.out.push_str("=\"");
    }

    /// Text within the quotes of an attribute.
    fn value(&mut self, text: &str) {
        self.escaped(text, "\"'");
    }

    /// Text between tags.
    fn words(&mut self, text: &str) {
        self.escaped(text, "");
    }

    /// Text with the signs of markup, and these quotes, as entities.
    fn escaped(&mut self, text: &str, quotes: &str) {
        for c in text.chars().map(printed) {
            match c {
                '&' => self.out.push_str("&amp;"),
                '<' => self.out.push_str("&lt;"),
                '>' => self.out.push_str("&gt;"),
                '"' if quotes.contains(c) => self.out.push_str("&quot;"),
                '\'' if quotes.contains(c) => self.out.push_str("&apos;"),
                c => self.out.push(c),
            }
        }
    }

    fn number(&mut self, name: &str, value: f64, decimals: usize) {
        self.begin_attribute(name);
        push_decimal(&mut self.out, value, decimals);
        self.out.push('"');
    }

    fn colour(&mut self, name: &str, tone: Tone, place: Place) {
        self.begin_attribute(name);
        self.out.push('#');
        self.out.push_str(&self.theme.colour(tone, place).hex());
        self.out.push('"');
    }

    fn element_with_text(&mut self, name: &str, id: Option<&str>, text: &str) {
        self.open(name);
        if let Some(id) = id {
            self.attribute("id", id);
        }
        self.out.push('>');
        self.words(text);
        self.close(name);
    }

    fn close(&mut self, name: &str) {
        self.out.push_str("</");
        self.out.push_str(name);
        self.out.push('>');
    }

    fn group(&mut self, group: &Group, around: Place) {
        let place = around.inside(group);
        self.open("g");
        if !group.class.is_empty() {
            self.attribute("class", &group.class);
        }
        let mut data: Vec<(&str, &str)> =
            group.data.iter().map(|(name, value)| (*name, value.as_str())).collect();
        data.sort_by_key(|(name, _)| *name);
        // Of what is said twice the last word counts.
        for said in data.chunk_by(|a, b| a.0 == b.0) {
            let Some((name, value)) = said.last() else { continue };
            self.out.push_str(" data-");
            self.out.push_str(name);
            self.out.push_str("=\"");
            self.value(value);
            self.out.push('"');
        }
        if place.old != around.old {
            // Words take the colour of what they stand in.
            self.colour("fill", Tone::Ink, place);
        }
        if let Some(id) = &group.id {
            self.begin_attribute("id");
            self.out.push(PREFIX);
            self.value(id);
            self.out.push('"');
        }
        if group.title.is_none() && group.children.is_empty() {
            self.out.push_str("/>");
            return;
        }
        self.out.push('>');
        if let Some(title) = &group.title {
            self.out.push('\n');
            self.element_with_text("title", None, title);
        }
        for child in &group.children {
            self.out.push('\n');
            match child {
                Node::Group(child) => self.group(child, place),
                Node::Mark(child) => self.mark(child, place),
                Node::Text(child) => self.text(child),
            }
        }
        self.out.push('\n');
        self.close("g");
    }

    fn mark(&mut self, mark: &Mark, place: Place) {
        let decimals = if mark.precise { PRECISE } else { LAYOUT };
        let circle =
            if let Shape::Circle { centre, radius } = mark.shape { Some((centre, radius)) } else { None };
        self.open(if circle.is_some() { "circle" } else { "path" });
        if !mark.class.is_empty() {
            self.attribute("class", mark.class);
        }
        match circle {
            Some((centre, _)) => {
                self.number("cx", centre.x, decimals);
                self.number("cy", centre.y, decimals);
            }
            None => {
                self.begin_attribute("d");
                self.path(&mark.shape, decimals);
                self.out.push('"');
            }
        }
        match mark.fill {
            Some(tone) => self.colour("fill", tone, place),
            None => self.attribute("fill", "none"),
        }
        if let Some((_, radius)) = circle {
            self.number("r", radius, decimals);
        }
        if let Some(pen) = mark.pen {
            self.colour("stroke", Tone::Ink, place);
            if let Some(dashes) = dashes(pen) {
                self.attribute("stroke-dasharray", &dashes);
            }
            self.number("stroke-width", pen.width, LAYOUT);
        }
        self.out.push_str("/>");
    }

    /// The path data of a shape.
    fn path(&mut self, shape: &Shape, decimals: usize) {
        let out = &mut self.out;
        let at = |out: &mut String, before: &str, p: Point| {
            out.push_str(before);
            push_decimal(out, p.x, decimals);
            out.push(' ');
            push_decimal(out, p.y, decimals);
        };
        let through = |out: &mut String, points: &[Point]| {
            out.push('M');
            for (i, p) in points.iter().enumerate() {
                at(out, if i > 0 { " L" } else { "" }, *p);
            }
        };
        match shape {
            Shape::Line(a, b) => through(out, &[*a, *b]),
            Shape::Polyline(points) => through(out, points),
            Shape::Polygon(points) => {
                through(out, points);
                out.push_str(" Z");
            }
            Shape::Curve(path) => {
                for (i, element) in path.elements().iter().enumerate() {
                    if i > 0 {
                        out.push(' ');
                    }
                    match *element {
                        PathEl::MoveTo(p) => at(out, "M", p),
                        PathEl::LineTo(p) => at(out, "L", p),
                        PathEl::QuadTo(a, p) => {
                            at(out, "Q", a);
                            at(out, " ", p);
                        }
                        PathEl::CurveTo(a, b, p) => {
                            at(out, "C", a);
                            at(out, " ", b);
                            at(out, " ", p);
                        }
                        PathEl::ClosePath => out.push('Z'),
                    }
                }
            }
            Shape::Arc { centre, radius, start, sweep } => {
                let large = if sweep.abs() > std::f64::consts::PI { '1' } else { '0' };
                let clockwise = if *sweep < 0.0 { '1' } else { '0' };
                at(out, "M", on_circle(*centre, *radius, *start));
                for before in [" A", " "] {
                    out.push_str(before);
                    push_decimal(out, *radius, decimals);
                }
                out.extend([' ', '0', ' ', large, ' ', clockwise]);
                at(out, " ", on_circle(*centre, *radius, start + sweep));
            }
            // An element of its own.
            Shape::Circle { .. } => {}
        }
    }

    /// One `<text>` without line breaks, which would be blanks between its runs. A line with words of Arabic script is one
    /// `<text>` per run: viewers order runs of two directions in one `<text>` each in its own way.
    fn text(&mut self, text: &Text) {
        let number = self.texts;
        self.texts += 1;
        let name: Option<String> = match self.lettered {
            Lettered::Live | Lettered::Embedded => None,
            #[cfg(feature = "png")]
            Lettered::Numbered => Some(format!("t{number}")),
            #[cfg(feature = "png")]
            Lettered::Outlined(outlines) => {
                let d = outlines.get(&format!("t{number}")).map_or("", String::as_str);
                self.open("path");
                self.class(text.class);
                self.attribute("role", "img");
                self.begin_attribute("aria-label");
                self.escaped(&text.content(), "\"");
                self.out.push_str(&format!("\" d=\"{d}\"/>"));
                return;
            }
        };
        let id = |out: &mut String, part: usize| {
            if let Some(name) = &name {
                out.push_str(&format!(" id=\"{name}-{part}\""));
            }
        };
        if !text.runs.iter().any(|run| run.face.is_arabic()) {
            self.open("text");
            self.class(text.class);
            id(&mut self.out, 0);
            self.out.push('>');
            text.runs.iter().for_each(|own| self.run(own));
            self.close("text");
            return;
        }
        self.open("g");
        self.class(text.class);
        self.out.push('>');
        for (part, own) in text.runs.iter().enumerate() {
            self.open("text");
            id(&mut self.out, part);
            match (own.face.is_arabic(), self.lettered) {
                (false, _) => {}
                (true, Lettered::Embedded) => self.class(ARABIC_CLASS),
                // Its quotes stand as they are.
                (true, _) => self.out.push_str(&format!(" font-family=\"{ARABIC_FAMILIES}\"")),
            }
            self.out.push('>');
            self.run(own);
            self.close("text");
        }
        self.close("g");
    }

    fn class(&mut self, class: &str) {
        if !class.is_empty() {
            self.out.push_str(" class=\"");
            self.out.push_str(class);
            self.out.push('"');
        }
    }

    fn run(&mut self, run: &Run) {
        self.open("tspan");
        self.number("x", run.at.x, LAYOUT);
        self.number("y", run.at.y, LAYOUT);
        self.number("font-size", run.size, LAYOUT);
        self.out.push_str(match run.face {
            Face::Upright | Face::Arabic => "",
            Face::Italic => " font-style=\"italic\"",
            Face::Bold | Face::ArabicBold => " font-weight=\"bold\"",
        });
        self.out.push('>');
        self.words(&run.text);
        self.close("tspan");
    }
}

fn dashes(pen: Pen) -> Option<String> {
    let lengths: Vec<String> = pen.dash.lengths()?.iter().map(|l| decimal(*l, LAYOUT)).collect();
    Some(lengths.join(" "))
}

/// A character that XML cannot hold becomes the replacement character.
const fn printed(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' => ' ',
        '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_from_outside_cannot_break_the_document() {
        let figure = Figure {
            width: 10.0,
            height: 10.0,
            title: "a < b & \u{0} \"c\"".to_owned(),
            description: String::new(),
            language: "en",
            root: Group::new("x").data("name", "\u{1}<\"'&>"),
        };
        let svg = write(&figure);
        assert!(svg.contains("title\">a &lt; b &amp; \u{fffd} \"c\"</title>"), "{svg}");
        let document = svg.split("data-name=").nth(1).unwrap();
        assert!(document.starts_with("\"\u{fffd}&lt;&quot;&apos;&amp;&gt;\""), "{document}");
    }
}
