//! One page that shows what each figure was, what it is, and where they differ. It needs no other file.

use std::fmt::Write;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;

use super::{Checked, Report, TOLD};

/// At most this many differing lines of an SVG are shown.
const LINES: usize = 12;
/// Resolution of the pictures of the page.
#[cfg(feature = "png")]
const DPI: f32 = 96.0;

const HEAD: &str = "<!doctype html>
<html lang=\"en\"><head><meta charset=\"utf-8\">
<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">
<title>Golden report</title>
<style>
body { font: 15px/1.4 sans-serif; margin: 2em; color: #111; background: #fff }
h2 { border-top: 1px solid #888; padding-top: 1em } h2 b { font-weight: normal; border: 1px solid; padding: 0 .4em }
.number b { color: #a00 } .content b { color: #930 } .cosmetic b { color: #06c }
figure { margin: 0 } figcaption { text-align: center } img { width: 100%; background: #fff; border: 1px solid #888; box-sizing: border-box }
.trio { display: grid; grid-template-columns: repeat(3, 1fr); gap: 8px; --at: 50% }
.range { display: none; width: 100% }
.slide:checked ~ .range { display: block; max-width: 1100px }
.slide:checked ~ .trio { grid-template-columns: 1fr; max-width: 1100px }
.slide:checked ~ .trio figure { grid-area: 1 / 1 }
.slide:checked ~ .trio .difference, .slide:checked ~ .trio figcaption { display: none }
.slide:checked ~ .trio .actual img { clip-path: inset(0 0 0 var(--at)) }
.over { position: relative; isolation: isolate } .over img + img { position: absolute; inset: 0; mix-blend-mode: difference }
pre { white-space: pre-wrap; overflow-wrap: anywhere; font-size: 12px; margin: 0 }
table { width: 100%; table-layout: fixed; border-collapse: collapse } td, th { border: 1px solid #888; vertical-align: top; padding: 4px }
</style></head><body>
<h1>Golden report</h1>
";

/// The report as one HTML file.
#[must_use]
pub fn html(report: &Report) -> String {
    let mut html = HEAD.to_owned();
    let _ = writeln!(html, "<p>{}</p>", escape(&report.summary()));
    let differing: Vec<&Checked> = report.by_cause().into_iter().flat_map(|(_, all)| all).collect();
    if differing.len() > 1 {
        html.push_str("<ul>\n");
        for (index, one) in differing.iter().enumerate() {
            let (name, word) = (escape(&one.name), one.verdict.word());
            let _ = writeln!(html, "<li><a href=\"#g{index}\">{name}</a>: {word}</li>");
        }
        html.push_str("</ul>\n");
    }
    for (index, one) in differing.iter().enumerate() {
        section(&mut html, index, one);
    }
    html.push_str("</body></html>\n");
    html
}

fn section(html: &mut String, index: usize, one: &Checked) {
    let (name, word) = (escape(&one.name), one.verdict.word());
    let _ = writeln!(html, "<section class=\"{word}\" id=\"g{index}\"><h2>{name} <b>{word}</b></h2>\n<ul>");
    if let Some(cause) = one.because() {
        let _ = writeln!(html, "<li><b>{}</b></li>", escape(&cause));
    }
    let told: Vec<String> =
        one.verdict.lines().iter().map(|line| format!("<li>{}</li>\n", escape(line))).collect();
    let (first, more) = told.split_at(told.len().min(TOLD));
    html.push_str(&first.concat());
    html.push_str("</ul>\n");
    if !more.is_empty() {
        let (count, more) = (more.len(), more.concat());
        let _ = writeln!(html, "<details><summary>and {count} more</summary><ul>{more}</ul></details>");
    }
    let [expected, actual] = [&one.expected, &one.actual].map(|side| side.as_deref().map(Shown::of));
    if expected.is_some() || actual.is_some() {
        let slides = matches!((&expected, &actual), (Some(Shown::Drawing(_)), Some(Shown::Drawing(_))));
        if slides {
            let _ = writeln!(
                html,
                "<input class=\"slide\" type=\"checkbox\" id=\"s{index}\"><label for=\"s{index}\">slide one over \
                 the other</label>\n<input class=\"range\" type=\"range\" value=\"50\" aria-label=\"expected to the \
                 left, actual to the right\" \
                 oninput=\"this.nextElementSibling.style.setProperty('--at', this.value + '%')\">"
            );
        }
        html.push_str("<div class=\"trio\">");
        let pictures = Pictures::of(expected.as_ref(), actual.as_ref());
        for (class, picture) in [
            ("expected", pictures.expected),
            ("actual", pictures.actual),
            ("difference", pictures.difference),
        ] {
            let _ = writeln!(
                html,
                "<figure class=\"{class}\">{}<figcaption>{class}</figcaption></figure>",
                picture.unwrap_or_else(|| "<p>none</p>".to_owned())
            );
        }
        html.push_str("</div>\n");
    }
    if let (Some(Shown::Drawing(expected)), Some(Shown::Drawing(actual))) = (expected, actual) {
        lines(html, expected, actual);
    }
    html.push_str("</section>\n");
}

/// The first lines that differ.
fn lines(html: &mut String, expected: &str, actual: &str) {
    let differing = expected.lines().zip(actual.lines()).filter(|(a, b)| a != b);
    let rows: String = differing
        .take(LINES)
        .map(|(a, b)| format!("<tr><td><pre>{}</pre><td><pre>{}</pre></tr>\n", escape(a), escape(b)))
        .collect();
    if !rows.is_empty() {
        let head = "<tr><th>expected<th>actual</tr>";
        let _ = writeln!(
            html,
            "<details><summary>lines of the SVG</summary><table>{head}\n{rows}</table></details>"
        );
    }
}

/// What a side of a comparison is.
enum Shown<'a> {
    Drawing(&'a str),
    Text(&'a str),
}

impl<'a> Shown<'a> {
    fn of(text: &'a str) -> Self {
        if text.trim_start_matches('\u{feff}').starts_with("<svg") {
            Self::Drawing(text)
        } else {
            Self::Text(text)
        }
    }

    fn html(&self) -> String {
        match self {
            Self::Drawing(svg) => drawing(svg),
            Self::Text(text) => format!("<pre>{}</pre>", escape(text)),
        }
    }
}

/// Three pictures, as HTML.
struct Pictures {
    expected: Option<String>,
    actual: Option<String>,
    difference: Option<String>,
}

impl Pictures {
    fn of(expected: Option<&Shown<'_>>, actual: Option<&Shown<'_>>) -> Self {
        let difference = match (expected, actual) {
            (Some(Shown::Drawing(expected)), Some(Shown::Drawing(actual))) => {
                Some(difference(expected, actual))
            }
            _ => None,
        };
        Self { expected: expected.map(Shown::html), actual: actual.map(Shown::html), difference }
    }
}

/// As dots where they can be drawn: with our typefaces, whatever the browser has.
#[cfg(feature = "png")]
fn drawing(svg: &str) -> String {
    use super::pixels::Picture;
    Picture::of_svg(svg, DPI).map_or_else(|_| browser(svg), |picture| dots(&picture))
}

#[cfg(feature = "png")]
fn dots(picture: &super::pixels::Picture) -> String {
    format!("<img src=\"data:image/png;base64,{}\" alt=\"\">", STANDARD.encode(picture.png()))
}

#[cfg(feature = "png")]
fn difference(expected: &str, actual: &str) -> String {
    use super::pixels::Picture;
    match (Picture::of_svg(expected, DPI), Picture::of_svg(actual, DPI)) {
        (Ok(expected), Ok(actual)) => dots(&expected.difference(&actual).picture),
        _ => blended(expected, actual),
    }
}

#[cfg(not(feature = "png"))]
fn drawing(svg: &str) -> String {
    browser(svg)
}

#[cfg(not(feature = "png"))]
fn difference(expected: &str, actual: &str) -> String {
    blended(expected, actual)
}

/// The browser draws, with the typefaces it has.
fn browser(svg: &str) -> String {
    format!("<img src=\"data:image/svg+xml;base64,{}\" alt=\"\">", STANDARD.encode(svg))
}

/// The browser subtracts: black is what is the same.
fn blended(expected: &str, actual: &str) -> String {
    format!("<div class=\"over\">{}{}</div>", browser(expected), browser(actual))
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
