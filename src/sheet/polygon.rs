//! A velocity or acceleration polygon as ink.

use std::collections::HashSet;

use kurbo::{Point, Rect, Vec2};

use super::compose::free_paper;
use super::coriolis;
use super::detail::{self, Spot};
use super::figure::{Group, Life, Mark, Pen, Shape, Tone};
use super::growth::Images;
use super::ink::{FINE, HEAD, LABEL, SMALL, THICK, THIN, arrow, dot, head, hull, page, right_angle};
use super::labels::{self, Others, Request, Site, place_among};
use super::notation::Notation;
use super::overlap::{clip, overlaps_in};
use super::rich::Rich;
use super::skeleton::Overlay;
use crate::graphical::construction::{
    Claim, ConstructionLine, Diagram, Image, Label, Reference, Step, Vector, VectorKind,
};
use crate::mechanism::PointId;
use crate::mechanism::quantity::{DiagramKind, Quantity};

/// Images closer than this on paper are one dot and share a label.
const COINCIDENT: f64 = 0.05;
/// Vectors shorter than this have no room for their name beside them; the steps name them.
const SHORTEST_NAMED: f64 = 3.0;
/// The class of a vector's name.
const VECTOR_NAME: &str = "label vector-name";
/// Beside a vector shorter than this there may be no room for its name, and a leader ties it.
const SHORT: f64 = 12.0;
/// Closer to a line than this a vector lies on it.
const LIES_ON: f64 = 0.25;
/// How far a line of unknown length runs past the intersection that ends its use.
const PAST: f64 = 4.0;

/// The polygon with its pole at the origin of the group; `steps` tell the senses of rotation. Its ink has lives where these
/// are told.
#[must_use]
pub fn draw(polygon: &Diagram, steps: &[Step], notation: &Notation<'_>, births: Option<&Images>) -> Group {
    draw_under(polygon, steps, notation, births, &Overlay::default())
}

/// The same with what is laid over it: the names of both are placed together, clear of the ink of both.
#[must_use]
pub fn draw_under(
    polygon: &Diagram,
    steps: &[Step],
    notation: &Notation<'_>,
    births: Option<&Images>,
    over: &Overlay,
) -> Group {
    let (class, figure_name) = headed(polygon.kind, notation);
    let unit = notation.unit(polygon.kind.dimension());
    let mut group = Group::new(class)
        .data("scale", number(polygon.si_per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol))
        .data("si-per-mm", number(polygon.si_per_mm));
    group.title = Some(figure_name.to_owned());

    group.group(link_images(polygon, notation, births));
    let window = window(polygon, free_paper(notation.scene));
    group.group(construction(polygon, notation, window, births));
    // Whole vectors over their parts, so that a thick line is never cut by a thin one's head.
    let whole = |v: &Vector| matches!(v.kind, VectorKind::Absolute | VectorKind::Relative);
    let all = || polygon.vectors.iter().enumerate();
    for (index, vector) in all().filter(|(_, v)| !whole(v)).chain(all().filter(|(_, v)| whole(v))) {
        let drawn = draw_vector(vector, polygon, notation, window);
        group.group(drawn.lived(births.and_then(|births| births.vectors.get(index).copied())));
    }
    group.group(right_angles(polygon, window, births));
    group.group(images(polygon, notation, window, births));

    let spots = detail::spots(polygon, window);
    let mut requests = labels(polygon, notation, window, &spots, births);
    if !spots.is_empty() {
        let (circles, names) =
            detail::circles(&spots, |spot| births.and_then(|births| detail::born(spot, births)));
        group.group(circles);
        requests.extend(names);
    }
    let others = unnamed(polygon, window, &requests, notation);
    if !over.ink.children.is_empty() {
        group.group(over.ink.clone());
        // Between the lines of two drawings a name may find room farther away only.
        requests.iter_mut().for_each(|request| request.leader = true);
    }
    requests.extend(over.labels.iter().cloned());
    let mut named = group.clone();
    named.group(place_among(&group, &requests, None, &others));
    // In the small drawing of a step there may be no room for the names of all vectors; its words tell them.
    if !overlaps_in(&named, None).is_empty() {
        let vectors = requests.iter_mut().filter(|request| request.class == VECTOR_NAME);
        vectors.for_each(|request| request.optional = true);
        named = group.clone();
        named.group(place_among(&group, &requests, None, &others));
    }
    let mut group = named;
    detail::add(&mut group, &spots, polygon, notation, births);
    if polygon.kind == DiagramKind::Acceleration {
        coriolis::add_insets(&mut group, polygon, steps, notation, births);
    }
    group
}

/// The points and vectors that have no name of their own among these: they are named in a detail, or too short for a name.
fn unnamed(polygon: &Diagram, window: Rect, requests: &[Request], notation: &Notation<'_>) -> Others {
    let names: HashSet<&String> = requests.iter().flat_map(|request| &request.names).collect();
    let has = |name: &String| names.contains(name);
    let images = polygon.images.iter().filter(|image| !has(&notation.image_name(image.label, polygon.kind)));
    let vectors = polygon.vectors.iter().filter(|v| !v.as_point && !has(&notation.quantity_name(v.quantity)));
    Others {
        points: images.map(|image| page(image.at)).filter(|at| window.contains(*at)).collect(),
        lines: vectors.map(|v| (page(v.from), page(v.to))).collect(),
    }
}

/// The class of a diagram, and what it is called.
fn headed(kind: DiagramKind, notation: &Notation<'_>) -> (&'static str, &'static str) {
    match kind {
        DiagramKind::Acceleration => ("acceleration polygon", notation.words.acceleration_diagram),
        _ => ("velocity polygon", notation.words.velocity_diagram),
    }
}

/// The ink of the polygon without its names, however far it goes: every vector `v`, line `r`, image `p` and link image `l`
/// in a group of its own, whose identifier tells its place in the polygon.
#[must_use]
pub fn apart(polygon: &Diagram, notation: &Notation<'_>, births: &Images) -> Group {
    /// Further than any ink.
    const EVERYWHERE: Rect = Rect::new(-1e9, -1e9, 1e9, 1e9);
    let (class, _) = headed(polygon.kind, notation);
    let mut group = Group::new(class);
    let named = |letter: char, index: usize, mut own: Group| {
        own.id = Some(format!("{letter}{index}"));
        own
    };
    for (index, image) in polygon.link_images.iter().enumerate() {
        let corners: Vec<Point> = image.corners.iter().map(|(_, at)| page(*at)).collect();
        let born = image.corners.iter().map(|(point, _)| births.point(*point)).max();
        let mut own = Group::new("image link-image").data("link", notation.number(image.link)).lived(born);
        own.mark(Mark::outlined(Shape::Polygon(corners), Pen::solid(FINE), Tone::Tint).precise());
        group.group(named('l', index, own));
    }
    for (index, line) in polygon.lines.iter().enumerate() {
        let ConstructionLine::Ray { from, to, claim, step } = line else { continue };
        let (from, to) = (page(*from), page(*to));
        let past = to + (to - from) * (PAST / (to - from).hypot().max(1e-9));
        let own = Group::new("ray").data("step", (step + 1).to_string());
        let mut own = match claim.map(|claim| notation.claim_data(claim)) {
            Some((name, value)) => own.data(name, value),
            None => own,
        };
        own = own.lived(births.lines.get(index).copied());
        own.mark(Mark::stroke(Shape::Line(from, past), Pen::solid(FINE)).precise());
        group.group(named('r', index, own));
    }
    // Whole vectors over their parts.
    let whole = |v: &Vector| matches!(v.kind, VectorKind::Absolute | VectorKind::Relative);
    let all = || polygon.vectors.iter().enumerate();
    for (index, vector) in all().filter(|(_, v)| !whole(v)).chain(all().filter(|(_, v)| whole(v))) {
        let own = draw_vector(vector, polygon, notation, EVERYWHERE);
        group.group(named('v', index, own.lived(births.vectors.get(index).copied())));
    }
    let mut pole = Group::new("image pole").lived(Some(births.pole));
    let circle = Shape::Circle { centre: Point::ORIGIN, radius: 0.75 };
    pole.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).precise());
    group.group(pole);
    for (index, image) in polygon.images.iter().enumerate() {
        let name = notation.image_name(image.label, polygon.kind);
        let mut own = Group::new("image").data("point", name).lived(Some(births.label(image.label)));
        own.mark(dot(page(image.at), THICK / 2.0).precise());
        group.group(named('p', index, own));
    }
    group
}

/// The name of images that are one point: a = b.
#[must_use]
pub fn name_of_images(labels: &[Label], polygon: &Diagram, notation: &Notation<'_>) -> Request {
    let names: Vec<Rich> = labels.iter().map(|label| notation.image(*label, polygon.kind)).collect();
    let text = Rich::join(&names, &Rich::upright(notation.words.comma.trim_end()));
    let radius = if labels.contains(&Label::Pole) { 0.9 } else { 0.4 };
    let site = Site::Around { at: Point::ORIGIN, radius, toward: None };
    let of = labels.iter().map(|label| notation.image_name(*label, polygon.kind));
    Request::new(text, LABEL, site, "label image-name").naming(of)
}

/// The name of a vector, or of several that are one stroke.
#[must_use]
pub fn name_of_vectors(vectors: &[&Vector], polygon: &Diagram, notation: &Notation<'_>) -> Request {
    let mut names: Vec<Rich> = Vec::new();
    for vector in vectors {
        let name = vector_name(vector, polygon, notation);
        if !names.contains(&name) {
            names.push(name);
        }
    }
    let text = Rich::join(&names, &Rich::upright("\u{a0}=\u{a0}"));
    let ends = vectors.first().map_or((Point::ORIGIN, Point::ORIGIN), |v| (page(v.from), page(v.to)));
    let site = Site::Along { from: ends.0, to: ends.1 };
    let of: Vec<String> = vectors.iter().map(|v| notation.quantity_name(v.quantity)).collect();
    Request::new(text, SMALL, site, VECTOR_NAME).naming(of)
}

fn number(value: f64) -> String {
    format!("{value}")
}

fn link_images(polygon: &Diagram, notation: &Notation<'_>, births: Option<&Images>) -> Group {
    let mut all = Group::new("images");
    for image in &polygon.link_images {
        let corners: Vec<Point> = image.corners.iter().map(|(_, at)| page(*at)).collect();
        let found = |births: &Images| image.corners.iter().map(|(p, _)| births.point(*p)).max();
        let born = births.and_then(found);
        let corners = hull(&corners);
        if is_flat(&corners) {
            // The image of a straight link is a line, as far as its points reach.
            if let Some((a, b)) = widest(&corners) {
                let mut own = Group::new("link-line").data("link", notation.number(image.link)).lived(born);
                own.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(FINE)).precise());
                all.group(own);
            }
            continue;
        }
        let mut own = Group::new("image link-image").data("link", notation.number(image.link)).lived(born);
        own.mark(Mark::area(Shape::Polygon(corners), Tone::Tint).precise());
        all.group(own);
    }
    all
}

/// Whether corners lie in a line, as far as anybody can see.
fn is_flat(corners: &[Point]) -> bool {
    /// Thinner than a tenth of the finest line, mm.
    const THINNEST: f64 = 0.01;
    let Some((&first, rest)) = corners.split_first() else { return true };
    let twice_area: f64 = rest.windows(2).map(|w| (w[0] - first).cross(w[1] - first)).sum();
    let longest = rest.iter().map(|at| at.distance(first)).fold(0.0, f64::max);
    twice_area.abs() <= THINNEST * longest
}

/// The two of some points that are furthest apart; none of points that are one.
fn widest(points: &[Point]) -> Option<(Point, Point)> {
    let pairs = points.iter().enumerate().flat_map(|(i, a)| points[i + 1..].iter().map(move |b| (*a, *b)));
    let (a, b) = pairs.max_by(|x, y| x.0.distance(x.1).total_cmp(&y.0.distance(y.1)))?;
    (a.distance(b) > COINCIDENT).then_some((a, b))
}

fn construction(polygon: &Diagram, notation: &Notation<'_>, window: Rect, births: Option<&Images>) -> Group {
    let mut all = Group::new("construction");
    for (index, line) in polygon.lines.iter().enumerate() {
        let born = births.and_then(|births| births.lines.get(index).copied());
        if let ConstructionLine::Ray { from, to, claim, step } = line {
            let (from, to) = (page(*from), page(*to));
            let d = to - from;
            if d.hypot() < 1e-9 {
                continue;
            }
            let past = to + d.normalize() * PAST;
            let Some((t0, t1)) = clip(from, past, window) else { continue };
            let (from, past) = (from.lerp(past, t0), from.lerp(past, t1));
            let mut own = Group::new("ray").data("step", (step + 1).to_string()).lived(born);
            if let Some(claim) = claim {
                let (name, value) = notation.claim_data(*claim);
                own = own.data(name, value);
            }
            own.mark(Mark::stroke(Shape::Line(from, past), Pen::solid(FINE)).precise());
            all.group(own);
        } else if let (Some(arc), ConstructionLine::Arc { at, .. }) = (short_arc(line), line)
            && window.contains(page(*at))
        {
            all.mark_lived(arc, born);
        }
    }
    all
}

/// An arc of the compass, some millimetres to both sides of the intersection it helped to find.
pub(super) fn short_arc(line: &ConstructionLine) -> Option<Mark> {
    let ConstructionLine::Arc { centre, radius, at, .. } = line else { return None };
    let (centre, at, radius) = (page(*centre), page(*at), *radius);
    if radius < 0.5 {
        return None;
    }
    let d = at - centre;
    let middle = libm::atan2(-d.y, d.x);
    let half = (PAST / radius).min(0.6);
    let shape = Shape::Arc { centre, radius, start: middle - half, sweep: 2.0 * half };
    Some(Mark::stroke(shape, Pen::solid(FINE)).class("arc").precise())
}

/// What is shown: all that has a place of its own. What was tried may lie far beyond it, or find no room on the paper; then
/// its lines end at the border.
fn window(polygon: &Diagram, (width, height): (f64, f64)) -> Rect {
    /// Blank around the polygon for what leads out of it.
    const BORDER: f64 = 14.0;
    /// Less where the paper ends.
    const LEAST: f64 = 5.0;
    /// What names at the border, the caption and headings take of the paper.
    const AROUND: (f64, f64) = (10.0, 30.0);
    let tried = |label: Label| matches!(label, Label::Trial { .. });
    let vectors = polygon.vectors.iter().filter(|v| !tried(v.tail) && !tried(v.head));
    let own = polygon.images.iter().filter(|image| !tried(image.label)).map(|image| image.at);
    let own = own.chain(vectors.flat_map(|v| [v.from, v.to])).map(page);
    let own = own.fold(Rect::ZERO, |all, at| all.union_pt(at));
    let border = |side: f64, paper: f64| ((paper - side) / 2.0).clamp(LEAST, BORDER);
    let bordered =
        |of: Rect| of.inflate(border(of.width(), width - AROUND.0), border(of.height(), height - AROUND.1));
    let all = polygon.images.iter().map(|image| page(image.at));
    let all = all.fold(own.inflate(BORDER, BORDER), |all, at| all.union_pt(at));
    // What lies a little beyond is taken in.
    let fits = |all: f64, own: f64, paper: f64| {
        all <= (1.4 * (own + 2.0 * BORDER)).max(60.0) && all + 2.0 * LEAST <= paper.max(own)
    };
    let takes = fits(all.width(), own.width(), width - AROUND.0)
        && fits(all.height(), own.height(), height - AROUND.1);
    bordered(if takes { all } else { own })
}

/// A vector that leads out of the window: as far as the border, with an arrowhead there.
fn cut_vector(from: Point, to: Point, window: Rect, step: usize) -> Group {
    let mut group = Group::new("ray cut").data("step", (step + 1).to_string());
    if let Some((t0, t1)) = clip(from, to, window) {
        let (a, b) = (from.lerp(to, t0), from.lerp(to, t1));
        group.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(THIN)).precise());
        if a.distance(b) > 2.0 * HEAD {
            group.mark(head(b, (b - a).normalize(), HEAD));
        }
    }
    group
}

fn draw_vector(vector: &Vector, polygon: &Diagram, notation: &Notation<'_>, window: Rect) -> Group {
    let ends = (page(vector.from), page(vector.to));
    if !window.contains(ends.0) || !window.contains(ends.1) {
        return cut_vector(ends.0, ends.1, window, vector.step);
    }
    let kind = match vector.kind {
        VectorKind::Absolute => "absolute",
        VectorKind::Relative => "relative",
        VectorKind::Normal => "normal",
        VectorKind::Tangential => "tangential",
        VectorKind::Sliding => "sliding",
        VectorKind::Coriolis => "coriolis",
    };
    let from = page(vector.from);
    let to = if vector.is_zero { from } else { page(vector.to) };
    let length = (to - from).hypot();
    let unit = notation.unit(polygon.kind.dimension());
    let name = notation.quantity_name(vector.quantity);
    let mut group = Group::new(format!("vector {kind}"))
        .data("quantity", name)
        .data("value", number(length * polygon.si_per_mm / unit.si))
        .data("from", notation.image_name(vector.tail, polygon.kind))
        .data("to", notation.image_name(vector.head, polygon.kind))
        .data("step", (vector.step + 1).to_string());
    if let Some(claim) = vector.claim {
        let (name, value) = notation.claim_data(claim);
        group = group.data(name, value);
    }
    if vector.as_point {
        group = group.data("as-point", "true");
        group.mark(dot(to, 0.55).precise());
        return group;
    }
    let width = if matches!(vector.kind, VectorKind::Absolute | VectorKind::Relative) { THICK } else { THIN };
    arrow(&mut group, from, to, width);
    group
}

/// A mark in the corner where a normal part ends and the tangential part begins.
fn right_angles(polygon: &Diagram, window: Rect, births: Option<&Images>) -> Group {
    let mut all = Group::new("right-angles");
    let shown = |v: &&Vector| !v.as_point && window.contains(page(v.to));
    for normal in polygon.vectors.iter().filter(|v| v.kind == VectorKind::Normal).filter(shown) {
        let tangential = polygon
            .vectors
            .iter()
            .enumerate()
            .find(|(_, t)| t.kind == VectorKind::Tangential && !t.as_point && t.tail == normal.head);
        let Some((index, tangential)) = tangential else { continue };
        let corner = page(normal.to);
        let back = page(normal.from) - corner;
        let on = page(tangential.to) - corner;
        let room = back.hypot().min(on.hypot());
        // Clear of the normal part's own head where there is room for both.
        let size = if back.hypot() > 2.5 * HEAD { HEAD * 0.85 } else { room * 0.3 };
        if room > 2.5 {
            let mut own = Group::default().lived(births.and_then(|b| b.vectors.get(index)).map(|l| l.born));
            right_angle(&mut own, corner, back, on, size.min(room * 0.4));
            all.adopt(own);
        }
    }
    all
}

fn images(polygon: &Diagram, notation: &Notation<'_>, window: Rect, births: Option<&Images>) -> Group {
    let mut all = Group::new("points");
    let mut pole = Group::new("image pole")
        .data("point", notation.image_name(Label::Pole, polygon.kind))
        .lived(births.map(|births| births.pole));
    let circle = Shape::Circle { centre: Point::ORIGIN, radius: 0.75 };
    pole.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).precise());
    all.group(pole);
    for image in polygon.images.iter().filter(|image| window.contains(page(image.at))) {
        let name = notation.image_name(image.label, polygon.kind);
        let born = births.map(|births| births.label(image.label));
        let mut own = Group::new("image").data("point", name).lived(born);
        own.mark(dot(page(image.at), THICK / 2.0).precise());
        all.group(own);
    }
    all
}

/// Where the name of a point stands: beside it, or where the line to it leaves the window.
fn shown(at: Point, polygon: &Diagram, window: Rect) -> Point {
    if window.contains(at) {
        return at;
    }
    // A line through trial images may begin with what lies outside.
    let rays = polygon.lines.iter().flat_map(|line| match line {
        ConstructionLine::Ray { from, to, .. } => {
            let (from, to) = (page(*from), page(*to));
            vec![(from, to), (to, from)]
        }
        ConstructionLine::Arc { .. } => Vec::new(),
    });
    let vectors = polygon.vectors.iter().flat_map(|v| [(v.from, v.to), (v.to, v.from)]);
    let vectors = vectors.map(|(from, to)| (page(from), page(to)));
    let mut leading = vectors.chain(rays).filter(|(_, to)| to.distance(at) < COINCIDENT);
    let out = leading.find_map(|(from, to)| clip(from, to, window).map(|(_, t)| from.lerp(to, t)));
    out.or_else(|| clip(window.center(), at, window).map(|(_, t)| window.center().lerp(at, t))).unwrap_or(at)
}

fn labels(
    polygon: &Diagram,
    notation: &Notation<'_>,
    window: Rect,
    spots: &[Spot],
    births: Option<&Images>,
) -> Vec<Request> {
    let in_detail = |label: Label| spots.iter().any(|spot| spot.has(label) && spot.first() != Some(label));
    let pole = Image { label: Label::Pole, at: [0.0, 0.0] };
    let mut groups: Vec<(Point, Vec<Label>)> = Vec::new();
    for image in std::iter::once(&pole).chain(&polygon.images) {
        let at = shown(detail::drawn_at(page(image.at), polygon), polygon, window);
        match groups.iter_mut().find(|(p, _)| p.distance(at) < COINCIDENT) {
            Some((_, labels)) if labels.contains(&image.label) => {}
            Some((_, labels)) => labels.push(image.label),
            None => groups.push((at, vec![image.label])),
        }
    }
    let mut requests = Vec::new();
    // What is drawn in a detail has its name there; beside the spot stands that of its first point.
    groups.retain(|(_, labels)| !labels.iter().all(|label| in_detail(*label)));
    for (at, labels) in groups {
        // A pin that bears the name of the link's own point, and the contact there, are one name.
        let mut names: Vec<Rich> = Vec::new();
        for name in labels.iter().map(|l| notation.image(*l, polygon.kind)) {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let text = Rich::join(&names, &Rich::upright(","));
        let radius = if labels.contains(&Label::Pole) { 0.9 } else { 0.4 };
        let about = spots.iter().find(|spot| labels.iter().any(|label| spot.has(*label)));
        let site = match about {
            Some(spot) => spot.site(),
            None => Site::Around { at, radius, toward: outward(at, polygon) },
        };
        let of = labels.iter().map(|l| notation.image_name(*l, polygon.kind));
        let born = births.and_then(|births| labels.iter().map(|l| births.label(*l)).min());
        let mut request = Request::new(text, LABEL, site, "label image-name").naming(of).lived(born);
        // What falls on a point that has a name already is named there when it is found.
        if let Some(births) = births {
            let mut own: Vec<(Rich, Vec<String>, Life)> = Vec::new();
            for label in &labels {
                let of = notation.image_name(*label, polygon.kind);
                let (name, born) = (notation.image(*label, polygon.kind), births.label(*label));
                match own.iter_mut().find(|(other, ..)| *other == name) {
                    Some((_, names, life)) => {
                        names.push(of);
                        life.born = life.born.min(born);
                    }
                    None => own.push((name, vec![of], born.into())),
                }
            }
            request = request.in_pieces(labels::pieces(own, &Rich::upright(",")));
        }
        request.leader = true;
        request.strict = true;
        // Beside a spot it is the name of one of several points.
        request.tie = about.map(|_| at);
        requests.push(request);
    }
    // A vector that is its own normal part is drawn twice and named once: A = Aⁿ.
    let mut named: Vec<Named> = Vec::new();
    let whole = |v: &Vector| matches!(v.kind, VectorKind::Absolute | VectorKind::Relative);
    let vectors = &polygon.vectors;
    let points: HashSet<(Label, Label)> =
        vectors.iter().filter(|v| v.as_point).map(|v| (v.tail, v.head)).collect();
    let all = || vectors.iter().enumerate();
    for (index, vector) in all().filter(|(_, v)| whole(v)).chain(all().filter(|(_, v)| !whole(v))) {
        let life = births.and_then(|births| births.vectors.get(index).copied());
        let (from, to) = (page(vector.from), page(vector.to));
        let name = vector_name(vector, polygon, notation);
        if from.distance(to) < SHORTEST_NAMED || !window.contains(from) || !window.contains(to) {
            continue;
        }
        if spots.iter().any(|spot| spot.has(vector.tail) && spot.has(vector.head)) {
            continue;
        }
        let same = |n: &Named| n.from.distance(from) < COINCIDENT && n.to.distance(to) < COINCIDENT;
        // What differs by a part that is drawn as a point is one stroke to the eye.
        let joined = |one: Label, other: Label| {
            one == other || points.contains(&(one, other)) || points.contains(&(other, one))
        };
        let nearly = |n: &Named| joined(n.ends[0], vector.tail) && joined(n.ends[1], vector.head);
        let of = notation.quantity_name(vector.quantity);
        match named.iter_mut().find(|n| same(n) || nearly(n)) {
            Some(own) => {
                own.about |= !same(own);
                own.life = earlier(own.life, life);
                match own.names.iter().position(|other| *other == name) {
                    Some(place) => {
                        let (names, since) = &mut own.of[place];
                        if !names.contains(&of) {
                            names.push(of);
                        }
                        *since = earlier(*since, life);
                    }
                    None => {
                        own.names.push(name);
                        own.of.push((vec![of], life));
                    }
                }
            }
            None => named.push(Named {
                from,
                to,
                ends: [vector.tail, vector.head],
                names: vec![name],
                about: false,
                of: vec![(vec![of], life)],
                life,
            }),
        }
    }
    for own in &named {
        let sign = if own.about { "\u{a0}≈\u{a0}" } else { "\u{a0}=\u{a0}" };
        let text = Rich::join(&own.names, &Rich::upright(sign));
        let site = |(from, to)| Site::Along { from, to };
        let mut sites = own.free_pieces(&named).into_iter().map(site);
        let first = sites.next().unwrap_or(site((own.from, own.to)));
        let mut request = Request::new(text, SMALL, first, VECTOR_NAME).naming(own.all_of()).lived(own.life);
        let apart = own.names.iter().zip(&own.of);
        let apart = apart.map(|(name, (of, life))| life.map(|life| (name.clone(), of.clone(), life)));
        if let Some(apart) = apart.collect() {
            request = request.in_pieces(labels::pieces(apart, &Rich::upright(sign)));
        }
        request.sites.extend(sites);
        request.strict = true;
        request.stroke = Some((own.from, own.to));
        request.leader = own.from.distance(own.to) < SHORT;
        requests.push(request);
    }
    requests
}

/// A stroke with the names of the vectors that lie on it.
struct Named {
    from: Point,
    to: Point,
    ends: [Label; 2],
    names: Vec<Rich>,
    /// They differ by less than is drawn.
    about: bool,
    /// Of each name the quantities, as the vectors' data call them, and since when it stands there.
    of: Vec<(Vec<String>, Option<Life>)>,
    life: Option<Life>,
}

/// The life of what is named by one name: from the first on, and used when any of it is.
fn earlier(one: Option<Life>, other: Option<Life>) -> Option<Life> {
    let (one, other) = one.zip(other)?;
    let read = [one.read, other.read].into_iter().flatten().min();
    Some(Life { born: one.born.min(other.born), read })
}

impl Named {
    /// All its quantities, each once.
    fn all_of(&self) -> Vec<String> {
        let mut all: Vec<String> = Vec::new();
        for of in self.of.iter().flat_map(|(of, _)| of) {
            if !all.contains(of) {
                all.push(of.clone());
            }
        }
        all
    }

    /// The pieces of the stroke beside which no shorter one lies, the longest first, then the whole: two
    /// vectors on one line are named where each is alone.
    fn free_pieces(&self, all: &[Self]) -> Vec<(Point, Point)> {
        let d = self.to - self.from;
        let length = d.hypot();
        let along = d / length;
        let off = |p: Point| (p - self.from).cross(along).abs();
        let mut covered: Vec<(f64, f64)> = all
            .iter()
            .filter(|o| off(o.from) < LIES_ON && off(o.to) < LIES_ON)
            .filter(|o| o.from.distance(o.to) < length - LIES_ON)
            .map(|o| [o.from, o.to].map(|p| ((p - self.from).dot(along) / length).clamp(0.0, 1.0)))
            .map(|[a, b]| (a.min(b), a.max(b)))
            .collect();
        covered.sort_by(|a, b| a.0.total_cmp(&b.0));
        let mut free: Vec<(f64, f64)> = Vec::new();
        let mut at = 0.0;
        for (a, b) in covered.into_iter().chain([(1.0, 1.0)]) {
            if (a - at) * length >= SHORTEST_NAMED {
                free.push((at, a));
            }
            at = f64::max(at, b);
        }
        free.sort_by(|a, b| (b.1 - b.0).total_cmp(&(a.1 - a.0)));
        if free != [(0.0, 1.0)] {
            free.push((0.0, 1.0));
        }
        free.into_iter().map(|(a, b)| (self.from.lerp(self.to, a), self.from.lerp(self.to, b))).collect()
    }
}

/// The symbol of a drawn vector, by the image that it starts from.
#[must_use]
pub fn vector_name(vector: &Vector, polygon: &Diagram, notation: &Notation<'_>) -> Rich {
    notation.symbol_from(vector.quantity, seen_from(vector, polygon), false)
}

/// The point at whose image a vector begins, or the normal part before it.
pub fn seen_from(vector: &Vector, polygon: &Diagram) -> Option<PointId> {
    let at = |v: &Vector| (page(v.from), page(v.to));
    // A tangential part starts where its normal part ends.
    let normal = polygon.vectors.iter().find(|n| {
        n.kind == VectorKind::Normal && n.head == vector.tail && at(n).1.distance(at(vector).0) < COINCIDENT
    });
    match (vector.tail, normal.map(|n| n.tail)) {
        (Label::Image { point, .. }, _) | (Label::Foot { .. }, Some(Label::Image { point, .. })) => {
            Some(point)
        }
        // What a lever's turning gives begins where it ends how the pin is driven: its line tells about which point it turns.
        (Label::Foot { .. }, None) => match (vector.quantity, vector.claim) {
            (
                Quantity::CoincidentVelocity(..) | Quantity::CoincidentTangential(..),
                Some(Claim::Perpendicular(Reference::Points(base, _))),
            ) => {
                let is_base = |label: Label| matches!(label, Label::Image { point, .. } if point == base);
                polygon.images.iter().any(|image| is_base(image.label)).then_some(base)
            }
            _ => None,
        },
        _ => None,
    }
}

/// The direction away from all lines that end in a point: there its name is out of the way.
fn outward(at: Point, polygon: &Diagram) -> Option<f64> {
    let mut sum = Vec2::ZERO;
    for vector in &polygon.vectors {
        let (from, to) = (page(vector.from), page(vector.to));
        for (own, other) in [(from, to), (to, from)] {
            if own.distance(at) < COINCIDENT && own.distance(other) > COINCIDENT {
                sum += (other - own).normalize();
            }
        }
    }
    (sum.hypot() > 0.2).then(|| libm::atan2(sum.y, -sum.x))
}
