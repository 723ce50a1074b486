//! An SVG whose text is outlines: the same groups, classes and data, each line of text a path.

use std::fmt::Write;

use resvg::tiny_skia::PathSegment;
use resvg::usvg::{Group, Node};

use super::number::decimal;
use super::png::{PngError, parse};
use super::svg::{self, Outlines};
use super::theme::Theme;
use crate::sheet::figure::Figure;

/// Decimals of a millimetre of an outline: a hundredth of a dot at 2400 dpi.
const DECIMALS: usize = 4;

/// The figure as an SVG document with outlined text.
///
/// # Errors
/// When the renderer does not read the figure.
pub fn write(figure: &Figure, theme: Theme) -> Result<String, PngError> {
    let tree = parse(&svg::write_numbered(figure))?;
    let mut outlines = Outlines::new();
    collect(tree.root(), &mut outlines);
    Ok(svg::write_outlined(figure, theme, outlines))
}

fn collect(group: &Group, outlines: &mut Outlines) {
    for node in group.children() {
        match node {
            Node::Group(group) => collect(group, outlines),
            Node::Text(text) => {
                // A line may be several texts: `t7-0`, `t7-1`.
                let line = text.id().split('-').next().unwrap_or_default();
                trace(text.flattened(), outlines.entry(line.to_owned()).or_default());
            }
            _ => {}
        }
    }
}

/// The paths of a flattened text as path data in the units of the SVG, which are millimetres: within a text
/// usvg counts from the text, and ours stand under no transform.
fn trace(group: &Group, d: &mut String) {
    for node in group.children() {
        match node {
            Node::Group(group) => trace(group, d),
            Node::Path(path) => {
                let Some(data) = path.data().clone().transform(path.abs_transform()) else { continue };
                let n = |value: f32| decimal(f64::from(value), DECIMALS);
                for segment in data.segments() {
                    let _ = match segment {
                        PathSegment::MoveTo(p) => write!(d, "M{} {}", n(p.x), n(p.y)),
                        PathSegment::LineTo(p) => write!(d, "L{} {}", n(p.x), n(p.y)),
                        PathSegment::QuadTo(a, p) => {
                            write!(d, "Q{} {} {} {}", n(a.x), n(a.y), n(p.x), n(p.y))
                        }
                        PathSegment::CubicTo(a, b, p) => {
                            write!(d, "C{} {} {} {} {} {}", n(a.x), n(a.y), n(b.x), n(b.y), n(p.x), n(p.y))
                        }
                        PathSegment::Close => write!(d, "Z"),
                    };
                }
            }
            _ => {}
        }
    }
}
