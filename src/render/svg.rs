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

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use kurbo::{BezPath, PathEl, Point};

use super::number::{decimal, push_decimal};
use super::theme::{Place, Theme};
use crate::sheet::figure::{Figure, Group, Mark, Node, Run, Shape, Text, Tone, on_circle};
use crate::sheet::font::{ARABIC_FAMILIES, ARABIC_FAMILY, FAMILIES, FAMILY, Face};

/// Decimals of a millimetre for ink that only has to look right.
const LAYOUT: usize = 3;
/// Decimals of a millimetre for ink whose length is a quantity.
const PRECISE: usize = 6;

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

/// The same with the typefaces that its text is set in embedded as `data:`, so that it looks alike where
/// they are not installed. Some 400 kB larger for each typeface used.
#[must_use]
pub fn write_embedded(figure: &Figure, theme: Theme) -> String {
    document(figure, theme, &Lettered::Live, Some(font_faces(figure)))
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
    #[cfg(feature = "png")]
    Numbered,
    #[cfg(feature = "png")]
    Outlined(Outlines),
}

fn document(figure: &Figure, theme: Theme, lettered: &Lettered, style: Option<String>) -> String {
    let mut body = Writer { theme, lettered, texts: 0, out: String::new(), identifiers: Vec::new() };
    body.group(&figure.root, Place::default());
    // The hash is of all that stands in the figure but the prefix itself.
    let named = fnv_on(fnv_on(fnv(figure.title.as_bytes()), b"\n"), figure.description.as_bytes());
    let hash = fnv_on(fnv_on(named, b"\n"), body.out.as_bytes());
    let prefix = format!("f{:08x}-", fold(hash));
    let described = !figure.description.is_empty();

    let mut out = String::with_capacity(body.out.len() + prefix.len() * body.identifiers.len() + 2048);
    out.push_str("<svg aria-labelledby=\"");
    out.push_str(&prefix);
    out.push_str("title");
    if described {
        out.push(' ');
        out.push_str(&prefix);
        out.push_str("desc");
    }
    out.push('"');
    if theme.paints_paper() {
        attribute(&mut out, "fill", &colour(theme, Tone::Ink, Place::default()));
    }
    attribute(&mut out, "font-family", FAMILIES);
    let [width, height] = [figure.width, figure.height].map(|length| decimal(length, LAYOUT));
    attribute(&mut out, "height", &format!("{height}mm"));
    attribute(&mut out, "lang", figure.language);
    attribute(&mut out, "role", "img");
    attribute(&mut out, "stroke-linejoin", "round");
    attribute(&mut out, "viewBox", &format!("0 0 {width} {height}"));
    attribute(&mut out, "width", &format!("{width}mm"));
    attribute(&mut out, "xml:lang", figure.language);
    out.push_str(" xmlns=\"http://www.w3.org/2000/svg\">\n");
    let mut head = |name: &str, id: &str, text: &str| {
        out.push_str(&format!("<{name} id=\"{prefix}{id}\">"));
        escape(&mut out, text);
        out.push_str(&format!("</{name}>\n"));
    };
    head("title", "title", &figure.title);
    if described {
        head("desc", "desc", &figure.description);
    }
    if let Some(style) = style {
        out.push_str(&style);
        out.push('\n');
    }
    if theme.paints_paper() {
        let paper = colour(theme, Tone::Paper, Place::default());
        out.push_str("<rect class=\"paper\"");
        attribute(&mut out, "fill", &paper);
        attribute(&mut out, "height", &height);
        attribute(&mut out, "width", &width);
        out.push_str("/>\n");
    }
    let mut written = 0;
    for at in body.identifiers {
        out.push_str(&body.out[written..at]);
        out.push_str(&prefix);
        written = at;
    }
    out.push_str(&body.out[written..]);
    out.push_str("\n</svg>\n");
    out
}

/// The FNV-1a hash: short, and the same everywhere.
pub(crate) fn fnv(bytes: &[u8]) -> u64 {
    fnv_on(0xcbf2_9ce4_8422_2325, bytes)
}

/// The hash of what was hashed before with more bytes after it.
fn fnv_on(hash: u64, bytes: &[u8]) -> u64 {
    bytes.iter().fold(hash, |hash, byte| (hash ^ u64::from(*byte)).wrapping_mul(0x100_0000_01b3))
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

/// One `@font-face` for each typeface that occurs.
fn font_faces(figure: &Figure) -> String {
    let mut used = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            used.extend(text.runs.iter().map(|run| run.face));
        }
    });
    let mut rules = String::from("<style>");
    for face in Face::ALL.into_iter().filter(|face| used.contains(face)) {
        let (family, style, weight, format) = match face {
            Face::Upright => (FAMILY, "normal", "normal", "opentype"),
            Face::Italic => (FAMILY, "italic", "normal", "opentype"),
            Face::Bold => (FAMILY, "normal", "bold", "opentype"),
            Face::Arabic => (ARABIC_FAMILY, "normal", "normal", "truetype"),
            Face::ArabicBold => (ARABIC_FAMILY, "normal", "bold", "truetype"),
        };
        rules.push_str(&format!(
            "@font-face{{font-family:'{family}';font-style:{style};font-weight:{weight};\
             src:url(data:font/sfnt;base64,{}) format('{format}')}}",
            STANDARD.encode(face.bytes())
        ));
    }
    rules.push_str("</style>");
    rules
}

/// Writes a figure into a buffer: each element on a line of its own, its attributes in the order of their names.
struct Writer<'a> {
    theme: Theme,
    lettered: &'a Lettered,
    /// Lines of text written so far.
    texts: usize,
    out: String,
    /// Where identifiers begin, before whose first character the prefix of the document is to be put.
    identifiers: Vec<usize>,
}

impl Writer<'_> {
    fn group(&mut self, group: &Group, place: Place) {
        let place = place.inside(group);
        self.out.push_str("<g");
        if !group.class.is_empty() {
            attribute(&mut self.out, "class", &group.class);
        }
        let mut data: Vec<&(&'static str, String)> = group.data.iter().collect();
        // Of two values by one name the later one stands.
        data.reverse();
        data.sort_by_key(|(name, _)| *name);
        data.dedup_by_key(|(name, _)| *name);
        for (name, value) in data {
            self.out.push_str(" data-");
            self.out.push_str(name);
            self.out.push_str("=\"");
            quoted(&mut self.out, value);
            self.out.push('"');
        }
        if let Some(id) = &group.id {
            self.out.push_str(" id=\"");
            self.identifiers.push(self.out.len());
            quoted(&mut self.out, id);
            self.out.push('"');
        }
        if group.title.is_none() && group.children.is_empty() {
            self.out.push_str("/>");
            return;
        }
        self.out.push_str(">\n");
        if let Some(title) = &group.title {
            self.out.push_str("<title>");
            escape(&mut self.out, title);
            self.out.push_str("</title>\n");
        }
        for child in &group.children {
            match child {
                Node::Group(child) => self.group(child, place),
                Node::Mark(child) => self.mark(child, place),
                Node::Text(child) => self.text(child),
            }
            self.out.push('\n');
        }
        self.out.push_str("</g>");
    }

    fn mark(&mut self, mark: &Mark, place: Place) {
        let decimals = if mark.precise { PRECISE } else { LAYOUT };
        let (theme, out) = (self.theme, &mut self.out);
        let fill = |out: &mut String| match mark.fill {
            Some(tone) => attribute(out, "fill", &colour(theme, tone, place)),
            None => attribute(out, "fill", "none"),
        };
        let class = |out: &mut String| {
            if !mark.class.is_empty() {
                attribute(out, "class", mark.class);
            }
        };
        if let Shape::Circle { centre, radius } = &mark.shape {
            out.push_str("<circle");
            class(out);
            number(out, "cx", centre.x, decimals);
            number(out, "cy", centre.y, decimals);
            fill(out);
            number(out, "r", *radius, decimals);
        } else {
            out.push_str("<path");
            class(out);
            out.push_str(" d=\"");
            path_data(out, &mark.shape, decimals);
            out.push('"');
            fill(out);
        }
        if let Some(pen) = mark.pen {
            attribute(out, "stroke", &colour(theme, Tone::Ink, place));
            if let Some(lengths) = pen.dash.lengths() {
                out.push_str(" stroke-dasharray=\"");
                for (i, length) in lengths.iter().enumerate() {
                    if i > 0 {
                        out.push(' ');
                    }
                    push_decimal(out, *length, LAYOUT);
                }
                out.push('"');
            }
            number(out, "stroke-width", pen.width, LAYOUT);
        }
        out.push_str("/>");
    }

    /// One `<text>` on one line: line breaks between runs would be blanks. A line with words of Arabic script is one
    /// `<text>` per run: viewers order runs of two directions in one `<text>` each in its own way.
    fn text(&mut self, text: &Text) {
        let number = self.texts;
        self.texts += 1;
        let class = |out: &mut String| {
            if !text.class.is_empty() {
                attribute(out, "class", text.class);
            }
        };
        let out = &mut self.out;
        let numbered = match self.lettered {
            Lettered::Live => false,
            #[cfg(feature = "png")]
            Lettered::Numbered => true,
            #[cfg(feature = "png")]
            Lettered::Outlined(outlines) => {
                out.push_str("<path");
                class(out);
                out.push_str(" role=\"img\" aria-label=\"");
                let from = out.len();
                escape(out, &text.content());
                let words = out.split_off(from).replace('"', "&quot;");
                let d = outlines.get(&format!("t{number}")).map_or("", String::as_str);
                out.push_str(&format!("{words}\" d=\"{d}\"/>"));
                return;
            }
        };
        let id = |out: &mut String, part: usize| {
            if numbered {
                out.push_str(&format!(" id=\"t{number}-{part}\""));
            }
        };
        if !text.runs.iter().any(|run| run.face.is_arabic()) {
            out.push_str("<text");
            class(out);
            id(out, 0);
            out.push('>');
            text.runs.iter().for_each(|own| run(out, own));
            out.push_str("</text>");
            return;
        }
        out.push_str("<g");
        class(out);
        out.push('>');
        for (part, own) in text.runs.iter().enumerate() {
            out.push_str("<text");
            id(out, part);
            if own.face.is_arabic() {
                out.push_str(" font-family=\"");
                out.push_str(ARABIC_FAMILIES);
                out.push('"');
            }
            out.push('>');
            run(out, own);
            out.push_str("</text>");
        }
        out.push_str("</g>");
    }
}

fn run(out: &mut String, run: &Run) {
    out.push_str("<tspan");
    number(out, "x", run.at.x, LAYOUT);
    number(out, "y", run.at.y, LAYOUT);
    number(out, "font-size", run.size, LAYOUT);
    out.push_str(match run.face {
        Face::Upright | Face::Arabic => "",
        Face::Italic => " font-style=\"italic\"",
        Face::Bold | Face::ArabicBold => " font-weight=\"bold\"",
    });
    out.push('>');
    escape(out, &run.text);
    out.push_str("</tspan>");
}

fn path_data(out: &mut String, shape: &Shape, decimals: usize) {
    let at = |out: &mut String, before: &str, p: Point| {
        out.push_str(before);
        push_decimal(out, p.x, decimals);
        out.push(' ');
        push_decimal(out, p.y, decimals);
    };
    match shape {
        Shape::Line(a, b) => {
            at(out, "M", *a);
            at(out, " L", *b);
        }
        Shape::Polyline(points) | Shape::Polygon(points) => {
            out.push('M');
            for (i, p) in points.iter().enumerate() {
                at(out, if i == 0 { "" } else { " L" }, *p);
            }
            if matches!(shape, Shape::Polygon(_)) {
                out.push_str(" Z");
            }
        }
        Shape::Curve(path) => curve(out, path, at),
        Shape::Arc { centre, radius, start, sweep } => {
            at(out, "M", on_circle(*centre, *radius, *start));
            at(out, " A", Point::new(*radius, *radius));
            out.push_str(if sweep.abs() > std::f64::consts::PI { " 0 1" } else { " 0 0" });
            out.push_str(if *sweep < 0.0 { " 1" } else { " 0" });
            at(out, " ", on_circle(*centre, *radius, start + sweep));
        }
        Shape::Circle { .. } => {}
    }
}

/// The path data of a curve.
fn curve(out: &mut String, path: &BezPath, at: impl Fn(&mut String, &str, Point)) {
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

fn colour(theme: Theme, tone: Tone, place: Place) -> String {
    format!("#{}", theme.tone(tone, place.about).hex())
}

/// Adds an attribute.
fn attribute(out: &mut String, name: &str, value: &str) {
    out.push(' ');
    out.push_str(name);
    out.push_str("=\"");
    quoted(out, value);
    out.push('"');
}

/// Adds an attribute whose value is a number.
fn number(out: &mut String, name: &str, value: f64, decimals: usize) {
    out.push(' ');
    out.push_str(name);
    out.push_str("=\"");
    push_decimal(out, value, decimals);
    out.push('"');
}

/// Characters that XML cannot hold become the replacement character.
fn printable(c: char) -> char {
    match c {
        '\t' | '\n' | '\r' => ' ',
        '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => '\u{fffd}',
        c => c,
    }
}

/// Adds text that stands between elements.
fn escape(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            c => out.push(printable(c)),
        }
    }
}

/// Adds text that stands in quotes.
fn quoted(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&apos;"),
            c => out.push(printable(c)),
        }
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
