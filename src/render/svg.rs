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

use std::cell::Cell;
use std::collections::BTreeMap;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kurbo::{BezPath, PathEl, Point};
use svg::Document;
use svg::node::Blob;
use svg::node::element::{Circle, Element, Group as GroupElement, Path, Rectangle};

use super::number::decimal;
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

/// Stands for what every identifier begins with, until the content is known; no text has it (see [`printable`]).
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
    let writer = Writer { theme: Theme::Mono, lettered: &Lettered::Live, texts: Cell::new(0) };
    writer.group(group, Place::default()).to_string().replace(PREFIX, "")
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
    let width = decimal(figure.width, LAYOUT);
    let height = decimal(figure.height, LAYOUT);
    let writer = Writer { theme, lettered, texts: Cell::new(0) };
    let body = writer.group(&figure.root, Place::default()).to_string();
    // The hash is of all that stands in the figure but the prefix itself.
    let content = format!("{}\n{}\n{}", figure.title, figure.description, body.replace(PREFIX, ""));
    let prefix = format!("f{:08x}-", fold(fnv(content.as_bytes())));
    let (title, description) = (format!("{prefix}title"), format!("{prefix}desc"));
    let described = !figure.description.is_empty();
    let mut document = Document::new()
        .set("width", format!("{width}mm"))
        .set("height", format!("{height}mm"))
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("xml:lang", figure.language)
        .set("lang", figure.language)
        .set("role", "img")
        .set("aria-labelledby", if described { format!("{title} {description}") } else { title.clone() })
        .set("font-family", FAMILIES)
        .set("stroke-linejoin", "round")
        .add(element_with_text("title", Some(&title), &figure.title));
    if described {
        document = document.add(element_with_text("desc", Some(&description), &figure.description));
    }
    if let Some(style) = style {
        document = document.add(Blob::new(style));
    }
    if theme.paints_paper() {
        let place = Place::default();
        document = document.set("fill", colour(theme, Tone::Ink, place)).add(
            Rectangle::new()
                .set("class", "paper")
                .set("width", width)
                .set("height", height)
                .set("fill", colour(theme, Tone::Paper, place)),
        );
    }
    let mut text = document.add(Blob::new(body.replace(PREFIX, &prefix))).to_string();
    text.push('\n');
    text
}

/// The FNV-1a hash: short, and the same everywhere.
pub(crate) fn fnv(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
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
                used.entry(face).or_default().add(face, &printable(&run.text));
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

/// The path data of a curve.
fn curve(path: &BezPath, at: impl Fn(Point) -> String) -> String {
    let parts: Vec<String> = path
        .elements()
        .iter()
        .map(|element| match *element {
            PathEl::MoveTo(p) => format!("M{}", at(p)),
            PathEl::LineTo(p) => format!("L{}", at(p)),
            PathEl::QuadTo(a, p) => format!("Q{} {}", at(a), at(p)),
            PathEl::CurveTo(a, b, p) => format!("C{} {} {}", at(a), at(b), at(p)),
            PathEl::ClosePath => "Z".to_owned(),
        })
        .collect();
    parts.join(" ")
}

fn element_with_text(name: &str, id: Option<&str>, text: &str) -> Blob {
    let id = id.map_or(String::new(), |id| format!(" id=\"{id}\""));
    Blob::new(format!("<{name}{id}>{}</{name}>", escape(text)))
}

struct Writer<'a> {
    theme: Theme,
    lettered: &'a Lettered,
    /// Lines of text written so far.
    texts: Cell<usize>,
}

impl Writer<'_> {
    fn group(&self, group: &Group, place: Place) -> GroupElement {
        let around = place;
        let place = place.inside(group);
        let mut element = GroupElement::new();
        if place.old != around.old {
            // Words take the colour of what they stand in.
            element = element.set("fill", colour(self.theme, Tone::Ink, place));
        }
        if !group.class.is_empty() {
            element = element.set("class", group.class.as_str());
        }
        if let Some(id) = &group.id {
            element = element.set("id", format!("{PREFIX}{id}"));
        }
        for (name, value) in &group.data {
            element = element.set(format!("data-{name}"), printable(value));
        }
        if let Some(title) = &group.title {
            element = element.add(element_with_text("title", None, title));
        }
        for child in &group.children {
            element = match child {
                Node::Group(child) => element.add(self.group(child, place)),
                Node::Mark(child) => element.add(self.mark(child, place)),
                Node::Text(child) => element.add(self.text(child)),
            };
        }
        element
    }

    fn mark(&self, mark: &Mark, place: Place) -> Element {
        let decimals = if mark.precise { PRECISE } else { LAYOUT };
        let n = |value: f64| decimal(value, decimals);
        let at = |p: Point| format!("{} {}", n(p.x), n(p.y));
        let mut element: Element = match &mark.shape {
            Shape::Line(a, b) => Path::new().set("d", format!("M{} L{}", at(*a), at(*b))).into(),
            Shape::Polyline(points) => Path::new().set("d", through(points, at)).into(),
            Shape::Polygon(points) => Path::new().set("d", format!("{} Z", through(points, at))).into(),
            Shape::Curve(path) => Path::new().set("d", curve(path, at)).into(),
            Shape::Circle { centre, radius } => {
                Circle::new().set("cx", n(centre.x)).set("cy", n(centre.y)).set("r", n(*radius)).into()
            }
            Shape::Arc { centre, radius, start, sweep } => {
                let large = i32::from(sweep.abs() > std::f64::consts::PI);
                let clockwise = i32::from(*sweep < 0.0);
                let from = on_circle(*centre, *radius, *start);
                let to = on_circle(*centre, *radius, start + sweep);
                let r = n(*radius);
                Path::new()
                    .set("d", format!("M{} A{r} {r} 0 {large} {clockwise} {}", at(from), at(to)))
                    .into()
            }
        };
        let attributes = element.get_attributes_mut();
        let mut set = |name: &str, value: String| {
            attributes.insert(name.to_owned(), value.into());
        };
        if !mark.class.is_empty() {
            set("class", mark.class.to_owned());
        }
        set("fill", mark.fill.map_or("none".to_owned(), |tone| colour(self.theme, tone, place)));
        if let Some(pen) = mark.pen {
            set("stroke", colour(self.theme, Tone::Ink, place));
            set("stroke-width", decimal(pen.width, LAYOUT));
            if let Some(dashes) = dashes(pen) {
                set("stroke-dasharray", dashes);
            }
        }
        element
    }

    /// One `<text>` as one blob: a node of the crate would put line breaks, and so blanks, between runs. A
    /// line with words of Arabic script is one `<text>` per run: viewers order runs of two directions in one
    /// `<text>` each in its own way.
    fn text(&self, text: &Text) -> Blob {
        let number = self.texts.get();
        self.texts.set(number + 1);
        let class = if text.class.is_empty() { String::new() } else { format!(" class=\"{}\"", text.class) };
        let name: Option<String> = match self.lettered {
            Lettered::Live | Lettered::Embedded => None,
            #[cfg(feature = "png")]
            Lettered::Numbered => Some(format!("t{number}")),
            #[cfg(feature = "png")]
            Lettered::Outlined(outlines) => {
                let d = outlines.get(&format!("t{number}")).map_or("", String::as_str);
                let words = attribute(&text.content());
                return Blob::new(format!("<path{class} role=\"img\" aria-label=\"{words}\" d=\"{d}\"/>"));
            }
        };
        let id = |part: usize| name.as_ref().map_or(String::new(), |name| format!(" id=\"{name}-{part}\""));
        if !text.runs.iter().any(|run| run.face.is_arabic()) {
            let runs: String = text.runs.iter().map(run).collect();
            return Blob::new(format!("<text{class}{}>{runs}</text>", id(0)));
        }
        let alone = |(part, own): (usize, &Run)| {
            let family = match (own.face.is_arabic(), self.lettered) {
                (false, _) => String::new(),
                (true, Lettered::Embedded) => format!(" class=\"{ARABIC_CLASS}\""),
                (true, _) => format!(" font-family=\"{ARABIC_FAMILIES}\""),
            };
            format!("<text{}{family}>{}</text>", id(part), run(own))
        };
        Blob::new(format!("<g{class}>{}</g>", text.runs.iter().enumerate().map(alone).collect::<String>()))
    }
}

fn run(run: &Run) -> String {
    let face = match run.face {
        Face::Upright | Face::Arabic => "",
        Face::Italic => " font-style=\"italic\"",
        Face::Bold | Face::ArabicBold => " font-weight=\"bold\"",
    };
    format!(
        "<tspan x=\"{}\" y=\"{}\" font-size=\"{}\"{face}>{}</tspan>",
        decimal(run.at.x, LAYOUT),
        decimal(run.at.y, LAYOUT),
        decimal(run.size, LAYOUT),
        escape(&run.text),
    )
}

fn through(points: &[Point], at: impl Fn(Point) -> String) -> String {
    let places: Vec<String> = points.iter().map(|p| at(*p)).collect();
    format!("M{}", places.join(" L"))
}

fn colour(theme: Theme, tone: Tone, place: Place) -> String {
    format!("#{}", theme.colour(tone, place).hex())
}

fn dashes(pen: Pen) -> Option<String> {
    let lengths: Vec<String> = pen.dash.lengths()?.iter().map(|l| decimal(*l, LAYOUT)).collect();
    Some(lengths.join(" "))
}

/// Characters that XML cannot hold become the replacement character.
fn printable(text: &str) -> String {
    text.chars()
        .map(|c| match c {
            '\t' | '\n' | '\r' => ' ',
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
            c => c,
        })
        .collect()
}

fn escape(text: &str) -> String {
    printable(text).replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

/// Text for an attribute in double quotes.
#[cfg(feature = "png")]
fn attribute(text: &str) -> String {
    escape(text).replace('"', "&quot;")
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
