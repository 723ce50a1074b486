//! A student's drawing as the SVG of a vector editor: its points are found by the letters beside them.
//!
//! A letter names the dot next to it, or where there is none the nearest end or corner of a line. Which figure it
//! belongs to is told by the layer (an `id`, class or label that holds `velocity`, `acceleration` or `skeleton`),
//! and without layers by its spelling: *A* is a joint, *a* a velocity image, *a′* an acceleration image.

use kurbo::{Affine, BezPath, PathEl, Point};
use roxmltree::{Document, Node};
use svgtypes::{Length, LengthUnit, Transform};

use super::answers::{Answers, FigurePoints};
use crate::mechanism::quantity::Order;
use crate::scene::Scene;
use crate::scene::diagnostic::{Fault, Res};

/// CSS's pixel.
const MM_PER_PX: f64 = 25.4 / 96.0;

/// A letter belongs to what lies within this many times its height.
const REACH: f64 = 2.5;

/// What the default style of SVG says.
const FONT_SIZE_PX: f64 = 16.0;

/// A letter of the drawing.
struct Letter {
    name: String,
    order: Order,
    /// The middle of its ink, about.
    middle: Point,
    /// Millimetres.
    height: f64,
    at: usize,
}

/// What a letter may name; millimetres, y down.
#[derive(Default)]
struct Marks {
    dots: Vec<Point>,
    ends: Vec<Point>,
}

/// Reads the points of a drawing into the answers.
pub(super) fn read(svg: &str, scene: &Scene, mut answers: Answers) -> Res<Answers> {
    for figure in points(svg, scene)? {
        answers.figures.push(figure);
    }
    Ok(answers)
}

/// The points of a drawing by figure, millimetres, y up.
pub(super) fn points(svg: &str, scene: &Scene) -> Res<Vec<FigurePoints>> {
    let document = Document::parse(svg).map_err(|error| {
        let place = error.pos();
        let line: usize = svg.split_inclusive('\n').take(place.row as usize - 1).map(str::len).sum();
        Fault::new(line + place.col as usize - 1, format!("not an SVG: {error}"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Fault::new(root.range().start, "neither JSON, nor a table, nor an SVG"));
    }
    let mut marks = Marks::default();
    let mut letters = Vec::new();
    walk(root, to_mm(root), scene, &mut marks, &mut letters);
    let mut figures: Vec<FigurePoints> = Vec::new();
    for letter in letters {
        let Some(mark) = marks.beside(&letter) else {
            let what = format!("nothing is marked beside the letter `{}`", letter.name);
            return Err(
                Fault::new(letter.at, what).mend("set it nearer to its dot or to the end of its line")
            );
        };
        let place = [mark.x, -mark.y];
        let index = figures.iter().position(|f| f.order == letter.order).unwrap_or_else(|| {
            figures.push(FigurePoints { order: letter.order, points: Vec::new() });
            figures.len() - 1
        });
        let points = &mut figures[index].points;
        if points.iter().any(|(known, at, _)| *known == letter.name && *at != place) {
            let fault = Fault::new(letter.at, format!("`{}` names two points", letter.name));
            return Err(fault.mend("keep one of the two, or tell the figures apart by layers"));
        }
        if !points.iter().any(|(known, ..)| *known == letter.name) {
            points.push((letter.name, place, letter.at));
        }
    }
    if figures.is_empty() {
        let fault = Fault::new(root.range().start, "no letter of this drawing names a point of the scene");
        return Err(fault.mend("write A at a joint, a at its velocity image, a′ at its acceleration image, o and o′ at the poles"));
    }
    Ok(figures)
}

impl Marks {
    /// What a letter names: a dot before the end of a line.
    fn beside(&self, letter: &Letter) -> Option<Point> {
        let nearest = |marks: &[Point]| {
            let near = |p: &Point| p.distance(letter.middle);
            let best = marks.iter().copied().min_by(|a, b| near(a).total_cmp(&near(b)))?;
            (near(&best) <= REACH * letter.height).then_some(best)
        };
        nearest(&self.dots).or_else(|| nearest(&self.ends))
    }
}

/// From the user units of the outermost element to millimetres.
fn to_mm(root: Node<'_, '_>) -> Affine {
    let numbers = |text: &str| -> Option<Vec<f64>> {
        text.split([' ', ',']).filter(|t| !t.is_empty()).map(|t| t.parse().ok()).collect()
    };
    let Some([x, y, width, _]) =
        root.attribute("viewBox").and_then(numbers).and_then(|n| <[f64; 4]>::try_from(n).ok())
    else {
        return Affine::scale(MM_PER_PX);
    };
    let stated = root.attribute("width").and_then(millimetres).filter(|_| width > 0.0);
    Affine::scale(stated.map_or(MM_PER_PX, |mm| mm / width)) * Affine::translate((-x, -y))
}

/// A length of CSS.
fn millimetres(text: &str) -> Option<f64> {
    let length: Length = text.trim().parse().ok()?;
    let unit = match length.unit {
        LengthUnit::None | LengthUnit::Px => MM_PER_PX,
        LengthUnit::In => 25.4,
        LengthUnit::Cm => 10.0,
        LengthUnit::Mm => 1.0,
        LengthUnit::Pt => 25.4 / 72.0,
        LengthUnit::Pc => 25.4 / 6.0,
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => return None,
    };
    Some(length.number * unit)
}

fn walk(node: Node<'_, '_>, outer: Affine, scene: &Scene, marks: &mut Marks, letters: &mut Vec<Letter>) {
    let number = |name: &str| node.attribute(name).and_then(|n| n.trim().parse::<f64>().ok()).unwrap_or(0.0);
    let own = node.attribute("transform").and_then(|text| text.parse::<Transform>().ok());
    let onto = own.map_or(outer, |t| outer * Affine::new([t.a, t.b, t.c, t.d, t.e, t.f]));
    let mut mark = |kind: fn(&mut Marks) -> &mut Vec<Point>, x: f64, y: f64| {
        let place = onto * Point::new(x, y);
        if place.is_finite() {
            kind(marks).push(place);
        }
    };
    match node.tag_name().name() {
        // What stands here is drawn elsewhere, or nowhere.
        "defs" | "marker" | "symbol" | "clipPath" | "mask" | "pattern" | "metadata" | "title" | "desc" => {
            return;
        }
        "circle" | "ellipse" => mark(|m| &mut m.dots, number("cx"), number("cy")),
        "line" => {
            mark(|m| &mut m.ends, number("x1"), number("y1"));
            mark(|m| &mut m.ends, number("x2"), number("y2"));
        }
        "polyline" | "polygon" => {
            let text = node.attribute("points").unwrap_or_default();
            let numbers: Vec<f64> =
                text.split([' ', ',', '\n', '\t']).filter_map(|n| n.parse().ok()).collect();
            for corner in numbers.chunks_exact(2) {
                mark(|m| &mut m.ends, corner[0], corner[1]);
            }
        }
        "path" => {
            let path = node.attribute("d").and_then(|d| BezPath::from_svg(d).ok()).unwrap_or_default();
            for element in path.elements() {
                if let PathEl::MoveTo(p)
                | PathEl::LineTo(p)
                | PathEl::QuadTo(_, p)
                | PathEl::CurveTo(_, _, p) = element
                {
                    mark(|m| &mut m.ends, p.x, p.y);
                }
            }
        }
        "text" => letters.extend(letter(node, onto, scene)),
        _ => {}
    }
    for child in node.children().filter(Node::is_element) {
        walk(child, onto, scene, marks, letters);
    }
}

/// A text that names a point of the scene; all other texts are captions and the like.
fn letter(text: Node<'_, '_>, onto: Affine, scene: &Scene) -> Option<Letter> {
    let written: String = text.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
    let name: String = written.split_whitespace().collect();
    let is_prime = |c: char| matches!(c, '\'' | '′' | '’');
    let bare: String = name.chars().filter(|c| !is_prime(*c) && *c != ',').collect();
    let named = |name: &str| scene.mechanism.points.iter().any(|p| p.name == name);
    let letters = bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let images = scene.mechanism.points.iter().map(|p| p.name.to_lowercase());
    let is_image = letters == "o" || images.into_iter().any(|image| image == letters || image == bare);
    let by_layer = text.ancestors().find_map(|node| layer(node));
    let by_spelling = if named(&name) && name.contains(char::is_uppercase) {
        Some(Order::Position)
    } else if !is_image {
        None
    } else if name.contains(is_prime) {
        Some(Order::Acceleration)
    } else {
        Some(Order::Velocity)
    };
    let order = match (by_layer, by_spelling?) {
        // An image in the layer of its polygon may go without its prime; a joint's name there is none of its points.
        (Some(layer), Order::Position) if layer != Order::Position => return None,
        (Some(layer), _) => layer,
        (None, spelled) => spelled,
    };
    let positioned = |node: &Node<'_, '_>| node.attribute("x").is_some() && node.attribute("y").is_some();
    let place = text.descendants().find(positioned).unwrap_or(text);
    let first = |name: &str| {
        let numbers = place.attribute(name).unwrap_or("0");
        numbers.split([' ', ',']).next().and_then(|n| n.parse::<f64>().ok()).unwrap_or(0.0)
    };
    let size = place.ancestors().find_map(font_size).unwrap_or(FONT_SIZE_PX);
    // Letters are about half as wide as high, their ink about two thirds of the height of the font.
    let width = 0.5 * size * name.chars().count() as f64;
    let before = match place.ancestors().find_map(|n| style(n, "text-anchor")).as_deref() {
        Some("middle") => 0.0,
        Some("end") => -0.5,
        _ => 0.5,
    };
    let middle = onto * Point::new(first("x") + before * width, first("y") - 0.33 * size);
    let height = size * onto.determinant().abs().sqrt();
    (middle.is_finite() && height.is_finite()).then(|| Letter {
        name,
        order,
        middle,
        height,
        at: text.range().start,
    })
}

/// The figure that a layer says to hold.
fn layer(node: Node<'_, '_>) -> Option<Order> {
    let named = node.attributes().filter(|a| matches!(a.name(), "id" | "class" | "label"));
    named.into_iter().find_map(|attribute| {
        let said = attribute.value().to_lowercase();
        let orders = [
            ("velocity", Order::Velocity),
            ("acceleration", Order::Acceleration),
            ("skeleton", Order::Position),
        ];
        orders.into_iter().find_map(|(word, order)| said.contains(word).then_some(order))
    })
}

/// A property, as attribute or in `style`.
fn style(node: Node<'_, '_>, name: &str) -> Option<String> {
    let within = |style: &str| {
        let declared = style.split(';').filter_map(|d| d.split_once(':'));
        declared.into_iter().find(|(key, _)| key.trim() == name).map(|(_, value)| value.trim().to_owned())
    };
    node.attribute("style").and_then(within).or_else(|| node.attribute(name).map(str::to_owned))
}

/// The size of letters in user units.
fn font_size(node: Node<'_, '_>) -> Option<f64> {
    let stated = style(node, "font-size")?;
    let length: Length = stated.parse().ok()?;
    match length.unit {
        LengthUnit::None | LengthUnit::Px => Some(length.number),
        LengthUnit::Em | LengthUnit::Ex | LengthUnit::Percent => None,
        _ => millimetres(&stated).map(|mm| mm / MM_PER_PX),
    }
}
