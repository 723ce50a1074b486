//! One self-contained page that shows what a sheet was, what it is, and where they differ.

use std::fmt::Write;
use std::path::PathBuf;

/// A picture of the report.
pub enum Picture {
    /// A PNG file.
    #[cfg_attr(not(feature = "png"), allow(dead_code))]
    Png(Vec<u8>),
    /// An SVG document; the browser's fonts stand in for the embedded ones.
    #[cfg_attr(feature = "png", allow(dead_code))]
    Svg(String),
    /// There is none.
    None,
}

/// A sheet that is not its golden.
pub struct Mismatch {
    pub name: String,
    pub why: String,
    /// Expected, actual, difference.
    pictures: [Picture; 3],
    /// The first lines that differ: expected, actual.
    lines: Vec<(String, String)>,
}

/// At most this many differing lines are shown.
const LINES: usize = 12;

impl Mismatch {
    /// Two SVG documents that differ; `None` where there is no golden one.
    pub fn new(name: &str, why: &str, expected: Option<&str>, actual: &str) -> Self {
        let lines = expected.map_or_else(Vec::new, |expected| {
            let differing = expected.lines().zip(actual.lines()).filter(|(e, a)| e != a);
            differing.take(LINES).map(|(e, a)| (e.to_owned(), a.to_owned())).collect()
        });
        let (pictures, pixels) = svg_pictures(expected, actual);
        Self { name: name.to_owned(), why: format!("{why}{pixels}"), pictures, lines }
    }

    /// A golden file that should not be there, or should be.
    pub fn missing(name: &str, why: &str) -> Self {
        Self {
            name: name.to_owned(),
            why: why.to_owned(),
            pictures: [Picture::None, Picture::None, Picture::None],
            lines: Vec::new(),
        }
    }

    /// Pictures that differ although the SVG does not.
    #[cfg(feature = "png")]
    pub fn pictures(name: &str, why: &str, pictures: [Picture; 3]) -> Self {
        Self { name: name.to_owned(), why: why.to_owned(), pictures, lines: Vec::new() }
    }
}

#[cfg(feature = "png")]
fn svg_pictures(expected: Option<&str>, actual: &str) -> ([Picture; 3], String) {
    use super::pixels::Grey;
    const DPI: f32 = 110.0;
    let actual = Grey::of_svg(actual, DPI);
    let Some(expected) = expected else {
        return ([Picture::None, Picture::Png(actual.png()), Picture::None], String::new());
    };
    let expected = Grey::of_svg(expected, DPI);
    let (difference, moved) = expected.difference(&actual);
    let pixels = match moved {
        0 => "; no pixel shows it".to_owned(),
        _ => format!("; {moved} of {} pixels show it", difference.levels.len()),
    };
    ([expected, actual, difference].map(|grey| Picture::Png(grey.png())), pixels)
}

#[cfg(not(feature = "png"))]
fn svg_pictures(expected: Option<&str>, actual: &str) -> ([Picture; 3], String) {
    let expected = expected.map_or(Picture::None, |e| Picture::Svg(e.to_owned()));
    ([expected, Picture::Svg(actual.to_owned()), Picture::None], String::new())
}

impl Picture {
    fn html(&self) -> String {
        match self {
            Self::Png(bytes) => format!("<img src=\"data:image/png;base64,{}\" alt=\"\">", base64(bytes)),
            Self::Svg(text) => {
                format!("<img src=\"data:image/svg+xml;base64,{}\" alt=\"\">", base64(text.as_bytes()))
            }
            Self::None => "none".to_owned(),
        }
    }
}

/// Writes `target/golden-report/report.html` and says where it is.
pub fn write(mismatches: &[Mismatch]) -> PathBuf {
    let mut html = String::from(
        "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>Golden report</title>\n<style>\
         body{font:15px sans-serif;margin:2em} table{width:100%;table-layout:fixed;border-collapse:collapse} \
         td,th{border:1px solid #888;vertical-align:top;padding:4px} img{width:100%} \
         pre{white-space:pre-wrap;overflow-wrap:anywhere;font-size:12px}</style>\n<h1>Golden report</h1>\n",
    );
    for mismatch in mismatches {
        let _ = writeln!(html, "<h2>{}</h2><p>{}</p>", escape(&mismatch.name), escape(&mismatch.why));
        html.push_str("<table><tr><th>expected<th>actual<th>difference</tr>\n<tr>");
        for picture in &mismatch.pictures {
            let _ = write!(html, "<td>{}", picture.html());
        }
        html.push_str("</tr></table>\n");
        if !mismatch.lines.is_empty() {
            html.push_str("<table><tr><th>expected<th>actual</tr>\n");
            for (expected, actual) in &mismatch.lines {
                let _ = writeln!(
                    html,
                    "<tr><td><pre>{}</pre><td><pre>{}</pre></tr>",
                    escape(expected),
                    escape(actual)
                );
            }
            html.push_str("</table>\n");
        }
    }
    html.push_str("</html>\n");
    let folder = target().join("golden-report");
    std::fs::create_dir_all(&folder).unwrap();
    let path = folder.join("report.html");
    std::fs::write(&path, html).unwrap();
    path
}

/// The target folder: the test binary lies in its `<profile>/deps`.
fn target() -> PathBuf {
    std::env::current_exe().unwrap().ancestors().nth(3).unwrap().to_owned()
}

fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word =
            chunk.iter().fold(0_u32, |word, byte| word << 8 | u32::from(*byte)) << (8 * (3 - chunk.len()));
        for place in 0..4 {
            let letter = LETTERS[(word >> (18 - 6 * place) & 63) as usize];
            out.push(if place <= chunk.len() { char::from(letter) } else { '=' });
        }
    }
    out
}

#[test]
fn base64_of_the_standard() {
    // RFC 4648, section 10.
    for (text, code) in [("", ""), ("f", "Zg=="), ("fo", "Zm8="), ("foo", "Zm9v"), ("foobar", "Zm9vYmFy")] {
        assert_eq!(base64(text.as_bytes()), code);
    }
}

#[test]
fn a_report_shows_both_sheets_and_the_lines() {
    let svg = |x: u32| {
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"9mm\" height=\"9mm\" viewBox=\"0 0 9 9\">\n<path d=\"M1 1 L{x} 8\" stroke=\"#000\"/>\n</svg>"
        )
    };
    let mismatch = Mismatch::new("probe", "the SVG differs", Some(&svg(7)), &svg(5));
    assert_eq!(mismatch.lines.len(), 1);
    assert!(mismatch.pictures.iter().take(2).all(|p| p.html().starts_with("<img src=\"data:image/")));
}
