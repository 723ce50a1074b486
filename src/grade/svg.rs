//! Numbers, lengths and transforms of an SVG, strictly: what cannot be read is told with its place and never taken for
//! zero, nor for nothing.

use kurbo::{Affine, Point};
use roxmltree::Node;
use svgtypes::{Length, LengthUnit, NumberListParser, PathParser, PathSegment, Transform};

use crate::limits;
use crate::scene::diagnostic::{Fault, Res};

/// CSS's pixel.
pub(super) const MM_PER_PX: f64 = 25.4 / 96.0;

/// What the default style of SVG says (user units).
pub(super) const FONT_SIZE_PX: f64 = 16.0;

const LENGTHS: &str = "write it in px, mm, cm, in, pt or pc, or as a bare number";

/// What style says and only an attribute is read for.
const MOVING: [&str; 11] =
    ["transform", "translate", "rotate", "scale", "cx", "cy", "x", "y", "d", "offset-path", "zoom"];

/// A fault at an attribute's value: "`cx="30%"` of a circle: what".
fn at_attribute(node: Node<'_, '_>, name: &str, what: &str) -> Fault {
    let attribute = node.attribute_node(name);
    let at = attribute.map_or_else(|| node.range().start, |attribute| attribute.range_value().start);
    let value = attribute.map_or("", |attribute| attribute.value());
    let shown: String = value.chars().take(SHOWN).collect();
    let more = if value.chars().nth(SHOWN).is_some() { "…" } else { "" };
    let element = node.tag_name().name();
    Fault::new(at, format!("`{name}=\"{shown}{more}\"` of `{element}` {what}"))
}

/// So many characters of a value stand in a message.
const SHOWN: usize = 40;

/// User units of one unit; none of what is a part of something else.
fn user_units(unit: LengthUnit) -> Option<f64> {
    let mm = match unit {
        LengthUnit::None | LengthUnit::Px => MM_PER_PX,
        LengthUnit::In => 25.4,
        LengthUnit::Cm => 10.0,
        LengthUnit::Mm => 1.0,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    };
    Some(mm / MM_PER_PX)
}

/// A length in user units; none where the attribute is missing.
pub(super) fn length(node: Node<'_, '_>, name: &str) -> Res<Option<f64>> {
    let Some(text) = node.attribute(name) else { return Ok(None) };
    read_length(node, name, text).map(Some)
}

/// The first of a list of lengths, as texts have them for their letters.
pub(super) fn first_length(node: Node<'_, '_>, name: &str) -> Res<Option<f64>> {
    let first = node
        .attribute(name)
        .and_then(|text| text.split([' ', ',', '\t', '\n', '\r']).find(|t| !t.is_empty()));
    first.map(|text| read_length(node, name, text)).transpose()
}

fn read_length(node: Node<'_, '_>, name: &str, text: &str) -> Res<f64> {
    let none = |what: &str| Err(at_attribute(node, name, what).mend(LENGTHS));
    let Ok(length) = text.trim().parse::<Length>() else { return none("is no length") };
    match user_units(length.unit) {
        Some(units) => Ok(length.number * units),
        None => none("is a part of something else, and no length on the page"),
    }
}

/// Corners of a `polyline` or `polygon`.
pub(super) fn points(node: Node<'_, '_>) -> Res<Vec<Point>> {
    let text = node.attribute("points").unwrap_or_default();
    let numbers: Result<Vec<f64>, _> = NumberListParser::from(text).collect();
    let numbers = numbers.map_err(|_| at_attribute(node, "points", "is no list of numbers"))?;
    if numbers.len() % 2 == 1 {
        return Err(at_attribute(node, "points", "has a coordinate without its other one"));
    }
    Ok(numbers.chunks_exact(2).map(|corner| Point::new(corner[0], corner[1])).collect())
}

/// Where the parts of a path begin and end.
pub(super) fn corners(node: Node<'_, '_>) -> Res<Vec<Point>> {
    let mut corners = Vec::new();
    let (mut here, mut first) = (Point::ZERO, Point::ZERO);
    for (index, segment) in PathParser::from(node.attribute("d").unwrap_or_default()).enumerate() {
        let segment = segment.map_err(|_| {
            let what = format!("cannot be read behind its first {index} parts");
            at_attribute(node, "d", &what)
        })?;
        let from = |abs: bool| if abs { Point::ZERO } else { here };
        let to = |abs: bool, x: f64, y: f64| Point::new(from(abs).x + x, from(abs).y + y);
        here = match segment {
            PathSegment::ClosePath { .. } => {
                here = first;
                continue;
            }
            PathSegment::MoveTo { abs, x, y } => {
                first = to(abs, x, y);
                first
            }
            PathSegment::HorizontalLineTo { abs, x } => Point::new(from(abs).x + x, here.y),
            PathSegment::VerticalLineTo { abs, y } => Point::new(here.x, from(abs).y + y),
            PathSegment::LineTo { abs, x, y }
            | PathSegment::CurveTo { abs, x, y, .. }
            | PathSegment::SmoothCurveTo { abs, x, y, .. }
            | PathSegment::Quadratic { abs, x, y, .. }
            | PathSegment::SmoothQuadratic { abs, x, y }
            | PathSegment::EllipticalArc { abs, x, y, .. } => to(abs, x, y),
        };
        corners.push(here);
    }
    Ok(corners)
}

/// The transform of an element, and the move of a drawing within the drawing.
pub(super) fn transform(node: Node<'_, '_>) -> Res<Affine> {
    let plain =
        |fault: Fault| fault.mend("save the drawing as a plain SVG, with `transform` as an attribute");
    for name in MOVING {
        let said = declared(node, name).filter(|said| !matches!(said.as_str(), "none" | "auto" | ""));
        if said.is_some() {
            let what = format!("says `{name}`, which is not read in a style");
            return Err(plain(at_attribute(node, "style", &what)));
        }
    }
    let own = match node.attribute("transform").map(str::trim) {
        None | Some("none") => Affine::IDENTITY,
        Some(text) => {
            let t: Transform = text.parse().map_err(|_| {
                at_attribute(node, "transform", "is no transform")
                    .mend("known are matrix(…), translate(…), scale(…), rotate(…), skewX(…) and skewY(…)")
            })?;
            if node.has_attribute("transform-origin") {
                return Err(plain(at_attribute(node, "transform-origin", "is not read")));
            }
            Affine::new([t.a, t.b, t.c, t.d, t.e, t.f])
        }
    };
    let inner = node.tag_name().name() == "svg" && node.parent_element().is_some();
    if !inner {
        return Ok(own);
    }
    if node.has_attribute("viewBox") {
        return Err(plain(at_attribute(
            node,
            "viewBox",
            "is that of a drawing within the drawing, and is not read",
        )));
    }
    let [x, y] = [length(node, "x")?, length(node, "y")?].map(Option::unwrap_or_default);
    Ok(own * Affine::translate((x, y)))
}

/// Refuses a style sheet that moves what it styles.
pub(super) fn still(style: Node<'_, '_>) -> Res<()> {
    let written: String = style.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
    for declaration in written.split([';', '{', '}']) {
        let Some((key, value)) = declaration.split_once(':') else { continue };
        let key = key.trim();
        if MOVING[..4].contains(&key) && !matches!(value.trim(), "none" | "") {
            let fault = Fault::new(
                style.range().start,
                format!("the style sheet says `{key}`, which is not read there"),
            );
            return Err(fault.mend("save the drawing as a plain SVG, with `transform` as an attribute"));
        }
    }
    Ok(())
}

/// From the user units of the outermost element to millimetres.
pub(super) fn to_mm(root: Node<'_, '_>) -> Res<Affine> {
    // The page is as large as its viewer, as where nothing is said.
    let side = |name: &str| -> Res<Option<f64>> {
        if matches!(root.attribute(name).map(str::trim), None | Some("100%" | "auto")) {
            return Ok(None);
        }
        let Some(units) = length(root, name)? else { return Ok(None) };
        if units <= 0.0 || units * MM_PER_PX > limits::PAPER_MM {
            return Err(at_attribute(root, name, "is no side of a page"));
        }
        Ok(Some(units * MM_PER_PX))
    };
    let [width, height] = [side("width")?, side("height")?];
    let Some(text) = root.attribute("viewBox") else { return Ok(Affine::scale(MM_PER_PX)) };
    let numbers: Option<Vec<f64>> = NumberListParser::from(text).collect::<Result<_, _>>().ok();
    let Some([x, y, wide, high]) = numbers.and_then(|numbers| <[f64; 4]>::try_from(numbers).ok()) else {
        let fault = at_attribute(root, "viewBox", "is not four numbers");
        return Err(fault.mend("they are the left and upper edge, width and height: \"0 0 210 297\""));
    };
    if wide <= 0.0 || high <= 0.0 {
        let fault = at_attribute(root, "viewBox", "has no width or no height");
        return Err(fault.mend("its last two numbers are width and height, greater than zero"));
    }
    let fit = root.attribute("preserveAspectRatio").unwrap_or_default();
    let scale = match [width.map(|mm| mm / wide), height.map(|mm| mm / high)] {
        [Some(a), Some(b)] if fit.contains("none") => {
            if (a / b - 1.0).abs() > UNEVEN {
                let fault = at_attribute(
                    root,
                    "preserveAspectRatio",
                    "makes a millimetre across another than one upward",
                );
                return Err(fault.mend("leave it out"));
            }
            a
        }
        [Some(a), Some(b)] if fit.contains("slice") => a.max(b),
        [Some(a), Some(b)] => a.min(b),
        [Some(a), None] | [None, Some(a)] => a,
        [None, None] => MM_PER_PX,
    };
    Ok(Affine::scale(scale) * Affine::translate((-x, -y)))
}

/// Scales of the two axes that differ by more are two.
const UNEVEN: f64 = 1e-3;

/// A property in `style`.
fn declared(node: Node<'_, '_>, name: &str) -> Option<String> {
    let declared = node.attribute("style")?.split(';').filter_map(|d| d.split_once(':'));
    declared.into_iter().find(|(key, _)| key.trim() == name).map(|(_, value)| value.trim().to_owned())
}

/// A property, as attribute or in `style`.
pub(super) fn style(node: Node<'_, '_>, name: &str) -> Option<String> {
    declared(node, name).or_else(|| node.attribute(name).map(str::to_owned))
}

/// The size of letters in user units, where `around` is that of the element around. What says nothing is as if it
/// were not said, as in CSS.
pub(super) fn font_size(node: Node<'_, '_>, around: f64) -> Option<f64> {
    let stated = style(node, "font-size")?;
    let word = [
        ("xx-small", 9.0),
        ("x-small", 10.0),
        ("small", 13.0),
        ("medium", FONT_SIZE_PX),
        ("large", 18.0),
        ("x-large", 24.0),
        ("xx-large", 32.0),
        ("smaller", around / 1.2),
        ("larger", around * 1.2),
    ];
    if let Some((_, size)) = word.iter().find(|(word, _)| *word == stated.trim()) {
        return Some(*size);
    }
    let length: Length = stated.trim().parse().ok()?;
    match length.unit {
        LengthUnit::Em => Some(length.number * around),
        LengthUnit::Ex => Some(length.number * around / 2.0),
        LengthUnit::Percent => Some(length.number / 100.0 * around),
        unit => user_units(unit).map(|units| units * length.number),
    }
}
