//! A figure as JSON: what its ink means, for programs and for comparing figures vector by vector and label
//! by label.
//!
//! ```text
//! { "format": "linkgram-figure", "version": 1, "language", "title", "description",
//!   "pages": [ { "width_mm", "height_mm",
//!     "panels": [ {
//!       "kind": "skeleton" | "velocity" | "acceleration" | …, "title", "caption",
//!       "scale": { "per_mm", "unit": "cm/s per mm", "si_per_mm" },
//!       "vectors": [ { "quantity", "kind", "tail": { "label", "at_mm" }, "head": { "label", "at_mm" },
//!                      "length_mm", "value", "si", "step", "as_point", "claim" } ],
//!       "points": [ { "name", "kind": "joint" | "image" | "pole" | …, "at_mm" } ],
//!       "lines": [ { "from_mm", "to_mm", "step", "claim" } ],
//!       "labels": [ { "text", "class", "at_mm", "size_mm", "box_mm" } ],
//!       "parts": [ { "class": [ … ], "data": { … }, "ink": [ … ] } ] } ],
//!     "texts": [ { "in", "text", "class", "at_mm", "size_mm", "box_mm" } ] } ] }
//! ```
//!
//! - Lengths and places are millimetres of the page, x to the right, y down from its upper left corner; six
//!   decimals where the ink carries a quantity, else three. A box is `[left, top, right, bottom]`.
//! - `value` is in the unit that `scale.unit` is per millimetre of, `si` the same in SI; `length_mm` is the
//!   vector's length on paper. A vector too short to draw is a point (`as_point`), both its ends there.
//! - `claim` says which direction a vector or a line of unknown length has: `{ "parallel": "A B" }` or
//!   `{ "perpendicular": "A B" }`, two points of the skeleton, or `guide` with a guide's name.
//! - `lines` are the construction lines; `parts` is all other ink by its groups, each with the classes of the
//!   groups around it; `texts` is all text outside of panels, `in` the class of the group it stands in.
//! - A key that has no value is left out. Keys are only added within a version.

use kurbo::{Point, Rect};
use serde_json::{Map, Value, json};

use super::number::decimal;
use super::pages::{self, Page};
use crate::sheet::figure::{Figure, Group, Mark, Node, Shape, Text};

/// The version of the schema.
pub const VERSION: u32 = 1;
/// Objects and lists no longer than this stand on one line.
const LINE: usize = 150;

/// The figure as JSON text.
#[must_use]
pub fn write(figure: &Figure) -> String {
    let mut out = String::new();
    print(&value(figure), 0, &mut out);
    out.push('\n');
    out
}

/// The figure as a JSON value.
#[must_use]
pub fn value(figure: &Figure) -> Value {
    let pages: Vec<Value> = pages::of(figure).iter().map(page).collect();
    let mut all = Map::new();
    all.insert("format".to_owned(), "linkgram-figure".into());
    all.insert("version".to_owned(), VERSION.into());
    all.insert("language".to_owned(), figure.language.into());
    all.insert("title".to_owned(), figure.title.clone().into());
    if !figure.description.is_empty() {
        all.insert("description".to_owned(), figure.description.clone().into());
    }
    all.insert("pages".to_owned(), pages.into());
    Value::Object(all)
}

fn page(page: &Page<'_>) -> Value {
    let mut out = Sorted { top: page.top, panels: Vec::new(), texts: Vec::new() };
    out.group(page.group);
    json!({
        "width_mm": rounded(page.width, 3), "height_mm": rounded(page.height, 3),
        "panels": out.panels, "texts": out.texts,
    })
}

/// What stands on a page.
struct Sorted {
    top: f64,
    panels: Vec<Value>,
    texts: Vec<Value>,
}

impl Sorted {
    fn group(&mut self, group: &Group) {
        if has(group, "panel") {
            self.panels.push(Panel::read(group, self.top));
            return;
        }
        for child in &group.children {
            match child {
                Node::Group(child) => self.group(child),
                Node::Text(text) => {
                    let mut all = Map::new();
                    all.insert("in".to_owned(), group.class.clone().into());
                    label(text, self.top, &mut all);
                    self.texts.push(all.into());
                }
                Node::Mark(_) => {}
            }
        }
    }
}

/// A drawing with its caption.
#[derive(Default)]
struct Panel {
    top: f64,
    /// Unit of the drawing per millimetre of paper, and the same in SI.
    scale: Option<(f64, f64)>,
    vectors: Vec<Value>,
    points: Vec<Value>,
    lines: Vec<Value>,
    labels: Vec<Value>,
    parts: Vec<Value>,
}

impl Panel {
    fn read(group: &Group, top: f64) -> Value {
        let mut out = Map::new();
        let mut panel = Self { top, ..Self::default() };
        let drawing = group.children.iter().find_map(|child| match child {
            Node::Group(drawing) => Some(drawing),
            _ => None,
        });
        if let Some(drawing) = drawing {
            let kind = drawing.class.split(' ').next().unwrap_or_default();
            out.insert("kind".to_owned(), kind.into());
            if let Some(title) = &drawing.title {
                out.insert("title".to_owned(), title.clone().into());
            }
        }
        let caption: Vec<String> = group
            .children
            .iter()
            .filter_map(|child| match child {
                Node::Text(text) if text.class == "caption" => Some(text.content()),
                _ => None,
            })
            .collect();
        if !caption.is_empty() {
            out.insert("caption".to_owned(), caption.join(" ").into());
        }
        if let Some(drawing) = drawing {
            let per_mm = number(drawing, "scale");
            let si = number(drawing, "si-per-mm");
            let mut scale = Map::new();
            put(&mut scale, "per_mm", per_mm);
            put(&mut scale, "unit", data(drawing, "unit"));
            put(&mut scale, "si_per_mm", si);
            if !scale.is_empty() {
                out.insert("scale".to_owned(), scale.into());
            }
            panel.scale = per_mm.zip(si);
        }
        panel.group(group, &mut Vec::new());
        for (name, list) in [
            ("vectors", panel.vectors),
            ("points", panel.points),
            ("lines", panel.lines),
            ("labels", panel.labels),
            ("parts", panel.parts),
        ] {
            out.insert(name.to_owned(), list.into());
        }
        out.into()
    }

    fn group<'a>(&mut self, group: &'a Group, around: &mut Vec<&'a str>) {
        if has(group, "vector") {
            self.vector(group);
            return;
        }
        if let (true, Some(Shape::Line(from, to))) = (has(group, "ray"), first_shape(group)) {
            let mut line = Map::new();
            line.insert("from_mm".to_owned(), self.place(*from, 6));
            line.insert("to_mm".to_owned(), self.place(*to, 6));
            put(&mut line, "step", number(group, "step"));
            put(&mut line, "claim", claim(group));
            self.lines.push(line.into());
            return;
        }
        if let (Some(name), Some(Shape::Circle { centre, .. })) = (data(group, "point"), first_shape(group)) {
            let class = group.class.split(' ').next().unwrap_or_default();
            let kind = if has(group, "pole") { "pole" } else { class };
            self.points.push(json!({ "name": name, "kind": kind, "at_mm": self.place(*centre, 6) }));
            return;
        }
        let depth = around.len();
        around.extend(group.class.split(' ').filter(|class| !class.is_empty() && *class != "panel"));
        let mut ink = Vec::new();
        for child in &group.children {
            match child {
                Node::Group(_) => {}
                Node::Mark(mark) => ink.push(self.ink(mark)),
                Node::Text(text) => {
                    let mut all = Map::new();
                    label(text, self.top, &mut all);
                    self.labels.push(all.into());
                }
            }
        }
        if !ink.is_empty() {
            let mut part = Map::new();
            part.insert("class".to_owned(), around.clone().into());
            if !group.data.is_empty() {
                let data = group.data.iter().map(|(name, value)| ((*name).to_owned(), value.clone().into()));
                part.insert("data".to_owned(), data.collect::<Map<_, _>>().into());
            }
            part.insert("ink".to_owned(), ink.into());
            self.parts.push(part.into());
        }
        for child in &group.children {
            if let Node::Group(child) = child {
                self.group(child, around);
            }
        }
        around.truncate(depth);
    }

    fn vector(&mut self, group: &Group) {
        let mut ends = None;
        for child in &group.children {
            let Node::Mark(mark) = child else { continue };
            match &mark.shape {
                Shape::Line(from, _) if mark.class == "shaft" => ends = Some((*from, *from)),
                Shape::Polygon(corners) if mark.class == "head" => {
                    ends = ends.zip(corners.first()).map(|((from, _), tip)| (from, *tip));
                }
                Shape::Circle { centre, .. } => ends = Some((*centre, *centre)),
                _ => {}
            }
        }
        let Some((from, to)) = ends else { return };
        let mut out = Map::new();
        put(&mut out, "quantity", data(group, "quantity"));
        let kind = group.class.split(' ').find(|class| *class != "vector").unwrap_or_default();
        out.insert("kind".to_owned(), kind.into());
        for (key, label, at) in [("tail", "from", from), ("head", "to", to)] {
            let mut end = Map::new();
            put(&mut end, "label", data(group, label));
            end.insert("at_mm".to_owned(), self.place(at, 6));
            out.insert(key.to_owned(), end.into());
        }
        if let Some(value) = number(group, "value") {
            if let Some((per_mm, si_per_mm)) = self.scale {
                out.insert("length_mm".to_owned(), rounded(value / per_mm, 6));
                out.insert("value".to_owned(), value.into());
                out.insert("si".to_owned(), (value / per_mm * si_per_mm).into());
            } else {
                out.insert("value".to_owned(), value.into());
            }
        }
        put(&mut out, "step", number(group, "step"));
        out.insert("as_point".to_owned(), (data(group, "as-point") == Some("true")).into());
        put(&mut out, "claim", claim(group));
        self.vectors.push(out.into());
    }

    fn place(&self, at: Point, decimals: usize) -> Value {
        place(at, self.top, decimals)
    }

    fn ink(&self, mark: &Mark) -> Value {
        let decimals = if mark.precise { 6 } else { 3 };
        let at = |p: &Point| self.place(*p, decimals);
        let all = |points: &[Point]| points.iter().map(at).collect::<Vec<_>>();
        let mut out = Map::new();
        if !mark.class.is_empty() {
            out.insert("class".to_owned(), mark.class.into());
        }
        match &mark.shape {
            Shape::Line(a, b) => out.insert("line".to_owned(), all(&[*a, *b]).into()),
            Shape::Polyline(points) => out.insert("line".to_owned(), all(points).into()),
            Shape::Polygon(points) => out.insert("polygon".to_owned(), all(points).into()),
            // As its straight pieces, within what the eye can tell.
            Shape::Curve(_) => {
                let pieces = mark.shape.outline();
                let ends = pieces.first().map(|(a, _)| *a).into_iter().chain(pieces.iter().map(|(_, b)| *b));
                out.insert("line".to_owned(), all(&ends.collect::<Vec<_>>()).into())
            }
            Shape::Circle { centre, radius } => {
                let circle = json!({ "centre": at(centre), "radius": rounded(*radius, decimals) });
                out.insert("circle".to_owned(), circle)
            }
            Shape::Arc { centre, radius, start, sweep } => {
                let arc = json!({
                    "centre": at(centre), "radius": rounded(*radius, decimals),
                    "start_deg": rounded(start.to_degrees(), 4), "sweep_deg": rounded(sweep.to_degrees(), 4),
                });
                out.insert("arc".to_owned(), arc)
            }
        };
        out.into()
    }
}

fn label(text: &Text, top: f64, out: &mut Map<String, Value>) {
    out.insert("text".to_owned(), text.content().trim().into());
    if !text.class.is_empty() {
        out.insert("class".to_owned(), text.class.into());
    }
    if let Some(first) = text.runs.first() {
        out.insert("at_mm".to_owned(), place(first.at, top, 3));
        let size = text.runs.iter().map(|run| run.size).fold(0.0, f64::max);
        out.insert("size_mm".to_owned(), rounded(size, 3));
    }
    if let Some(Rect { x0, y0, x1, y1 }) = text.bounds() {
        let corners = [x0, y0 - top, x1, y1 - top].map(|v| rounded(v, 3));
        out.insert("box_mm".to_owned(), corners.to_vec().into());
    }
}

fn has(group: &Group, class: &str) -> bool {
    group.class.split(' ').any(|c| c == class)
}

fn data<'a>(group: &'a Group, name: &str) -> Option<&'a str> {
    group.data.iter().find(|(n, _)| *n == name).map(|(_, value)| value.as_str())
}

fn number(group: &Group, name: &str) -> Option<f64> {
    data(group, name)?.parse().ok()
}

fn claim(group: &Group) -> Option<Value> {
    ["parallel", "perpendicular"].into_iter().find_map(|name| Some(json!({ name: data(group, name)? })))
}

fn first_shape(group: &Group) -> Option<&Shape> {
    group.children.iter().find_map(|child| match child {
        Node::Mark(mark) => Some(&mark.shape),
        _ => None,
    })
}

fn put(out: &mut Map<String, Value>, key: &str, value: Option<impl Into<Value>>) {
    if let Some(value) = value {
        let value = match value.into() {
            // A count is written as one.
            Value::Number(n) => whole(&n).map_or(Value::Number(n), Value::from),
            other => other,
        };
        out.insert(key.to_owned(), value);
    }
}

fn whole(n: &serde_json::Number) -> Option<i64> {
    let value = n.as_f64()?;
    (value == value.trunc() && value.abs() < 1e15).then_some(value as i64)
}

fn place(at: Point, top: f64, decimals: usize) -> Value {
    vec![rounded(at.x, decimals), rounded(at.y - top, decimals)].into()
}

/// The number as the one formatter writes it.
fn rounded(value: f64, decimals: usize) -> Value {
    let text = decimal(value, decimals);
    text.parse::<i64>()
        .map(Value::from)
        .or_else(|_| text.parse::<f64>().map(Value::from))
        .unwrap_or(Value::Null)
}

/// Short things on one line, so that a difference is a line.
fn print(value: &Value, depth: usize, out: &mut String) {
    let short = value.to_string();
    let (open, close, items): (char, char, Vec<(Option<&String>, &Value)>) = match value {
        Value::Object(map) if short.len() > LINE => {
            ('{', '}', map.iter().map(|(k, v)| (Some(k), v)).collect())
        }
        Value::Array(list) if short.len() > LINE || depth < 4 && !list.is_empty() => {
            ('[', ']', list.iter().map(|v| (None, v)).collect())
        }
        _ => {
            out.push_str(&short);
            return;
        }
    };
    out.push(open);
    let count = items.len();
    for (i, (key, item)) in items.into_iter().enumerate() {
        out.push('\n');
        out.extend(std::iter::repeat_n(' ', depth + 1));
        if let Some(key) = key {
            out.push_str(&format!("{}: ", Value::from(key.as_str())));
        }
        print(item, depth + 1, out);
        if i + 1 < count {
            out.push(',');
        }
    }
    out.push('\n');
    out.extend(std::iter::repeat_n(' ', depth));
    out.push(close);
}
