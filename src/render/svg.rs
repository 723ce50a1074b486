//! A figure as SVG 1.1: millimetres, real text, no scripts, nothing from outside.
//!
//! What a reader of the file may rely on: coordinates are millimetres of the page, y down, without
//! transforms. A `vector` group holds a `shaft`, whose first point is the vector's tail, and a `head`,
//! whose first point is its tip; `data-quantity`, `data-value` (in the unit of its polygon's `data-unit`),
//! `data-from`, `data-to` and, where a direction is claimed, `data-parallel` or `data-perpendicular` (two
//! points, or `guide` and the name that a group of the skeleton carries as `data-guide`: its rider, and its
//! link where one pin rides on several; the first stroke of that group has the guide's direction). A vector
//! too short to draw is a circle with `data-as-point`. The polygon's and the skeleton's `data-scale` is its
//! unit per millimetre; images and joints carry `data-point`, which no two places of a figure share.

use kurbo::Point;
use svg::Document;
use svg::node::Blob;
use svg::node::element::{Circle, Element, Group as GroupElement, Path};

use super::number::decimal;
use crate::sheet::figure::{Dash, Figure, Group, Mark, Node, Pen, Run, Shape, Text, Tone, on_circle};
use crate::sheet::font::{ARABIC_FAMILIES, FAMILIES, Face};

/// Decimals of a millimetre for ink that only has to look right.
const LAYOUT: usize = 3;
/// Decimals of a millimetre for ink whose length is a quantity.
const PRECISE: usize = 6;

/// The figure as an SVG document.
#[must_use]
pub fn write(figure: &Figure) -> String {
    let width = decimal(figure.width, LAYOUT);
    let height = decimal(figure.height, LAYOUT);
    let mut document = Document::new()
        .set("width", format!("{width}mm"))
        .set("height", format!("{height}mm"))
        .set("viewBox", format!("0 0 {width} {height}"))
        .set("xml:lang", figure.language)
        .set("role", "img")
        .set("font-family", FAMILIES)
        .set("stroke-linejoin", "round")
        .add(element_with_text("title", &figure.title));
    if !figure.description.is_empty() {
        document = document.add(element_with_text("desc", &figure.description));
    }
    let mut text = document.add(group(&figure.root)).to_string();
    text.push('\n');
    text
}

/// Seconds for which a step of a film is shown.
const SECONDS: usize = 3;

/// A film: the figures, all of one size, one after the other, played by the viewer itself without a script.
/// Where nothing is played (on paper, in programs that know no animations, for readers who want none) the
/// last figure is shown. An empty film is an empty document.
#[must_use]
pub fn write_film(frames: &[Figure]) -> String {
    let Some((last, before)) = frames.split_last() else { return Document::new().to_string() };
    let count = frames.len();
    let mut style = String::new();
    let mut root = Group::new("film");
    for (i, frame) in before.iter().chain([last]).enumerate() {
        let mut group = frame.root.clone();
        group.class = format!("frame f{i}");
        root.group(group);
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
    let svg = write(&Figure { root, ..last.clone() });
    // What is hidden until it is played is hidden by an attribute, over which the animation wins.
    let mut hidden = svg;
    for i in 0..before.len() {
        let class = format!("class=\"frame f{i}\"");
        hidden = hidden.replacen(&class, &format!("{class} visibility=\"hidden\""), 1);
    }
    hidden.replacen("<g class=\"film\">", &format!("<style>{style}</style>\n<g class=\"film\">"), 1)
}

fn element_with_text(name: &str, text: &str) -> Blob {
    Blob::new(format!("<{name}>{}</{name}>", escape(text)))
}

fn group(group: &Group) -> GroupElement {
    let mut element = GroupElement::new();
    if !group.class.is_empty() {
        element = element.set("class", group.class.as_str());
    }
    if let Some(id) = &group.id {
        element = element.set("id", id.as_str());
    }
    for (name, value) in &group.data {
        element = element.set(format!("data-{name}"), printable(value));
    }
    if let Some(title) = &group.title {
        element = element.add(element_with_text("title", title));
    }
    for child in &group.children {
        element = match child {
            Node::Group(child) => element.add(self::group(child)),
            Node::Mark(child) => element.add(mark(child)),
            Node::Text(child) => element.add(text(child)),
        };
    }
    element
}

fn mark(mark: &Mark) -> Element {
    let decimals = if mark.precise { PRECISE } else { LAYOUT };
    let n = |value: f64| decimal(value, decimals);
    let at = |p: Point| format!("{} {}", n(p.x), n(p.y));
    let mut element: Element = match &mark.shape {
        Shape::Line(a, b) => Path::new().set("d", format!("M{} L{}", at(*a), at(*b))).into(),
        Shape::Polyline(points) => Path::new().set("d", through(points, at)).into(),
        Shape::Polygon(points) => Path::new().set("d", format!("{} Z", through(points, at))).into(),
        Shape::Circle { centre, radius } => {
            Circle::new().set("cx", n(centre.x)).set("cy", n(centre.y)).set("r", n(*radius)).into()
        }
        Shape::Arc { centre, radius, start, sweep } => {
            let large = i32::from(sweep.abs() > std::f64::consts::PI);
            let clockwise = i32::from(*sweep < 0.0);
            let from = on_circle(*centre, *radius, *start);
            let to = on_circle(*centre, *radius, start + sweep);
            let r = n(*radius);
            Path::new().set("d", format!("M{} A{r} {r} 0 {large} {clockwise} {}", at(from), at(to))).into()
        }
    };
    let attributes = element.get_attributes_mut();
    let mut set = |name: &str, value: String| {
        attributes.insert(name.to_owned(), value.into());
    };
    if !mark.class.is_empty() {
        set("class", mark.class.to_owned());
    }
    set("fill", mark.fill.map_or("none", colour).to_owned());
    if let Some(pen) = mark.pen {
        set("stroke", colour(Tone::Ink).to_owned());
        set("stroke-width", decimal(pen.width, LAYOUT));
        if let Some(dashes) = dashes(pen) {
            set("stroke-dasharray", dashes);
        }
    }
    element
}

fn through(points: &[Point], at: impl Fn(Point) -> String) -> String {
    let places: Vec<String> = points.iter().map(|p| at(*p)).collect();
    format!("M{}", places.join(" L"))
}

fn colour(tone: Tone) -> &'static str {
    match tone {
        Tone::Ink => "#000000",
        Tone::Paper => "#ffffff",
        Tone::Tint => "#e4ebf2",
    }
}

fn dashes(pen: Pen) -> Option<String> {
    let lengths: &[f64] = match pen.dash {
        Dash::Solid => return None,
        Dash::Dashed => &[2.0, 1.0],
        Dash::Chain => &[5.0, 0.9, 0.4, 0.9],
    };
    let lengths: Vec<String> = lengths.iter().map(|l| decimal(*l, LAYOUT)).collect();
    Some(lengths.join(" "))
}

/// One `<text>` as one blob: a node of the crate would put line breaks, and so blanks, between runs. A line
/// with words of Arabic script is one `<text>` per run: viewers order runs of two directions in one `<text>`
/// each in its own way.
fn text(text: &Text) -> Blob {
    let class = if text.class.is_empty() { String::new() } else { format!(" class=\"{}\"", text.class) };
    if !text.runs.iter().any(|run| run.face.is_arabic()) {
        return Blob::new(format!("<text{class}>{}</text>", text.runs.iter().map(run).collect::<String>()));
    }
    let alone = |own: &Run| {
        let family =
            if own.face.is_arabic() { format!(" font-family=\"{ARABIC_FAMILIES}\"") } else { String::new() };
        format!("<text{family}>{}</text>", run(own))
    };
    Blob::new(format!("<g{class}>{}</g>", text.runs.iter().map(alone).collect::<String>()))
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
        assert!(svg.contains("<title>a &lt; b &amp; \u{fffd} \"c\"</title>"), "{svg}");
        let document = svg.split("data-name=").nth(1).unwrap();
        assert!(document.starts_with("\"\u{fffd}&lt;&quot;&apos;&amp;&gt;\""), "{document}");
    }
}
