//! Details of a polygon: where its points crowd, a circle about the spot and the same ink beside it at a true multiple.

use kurbo::{Point, Rect};

use super::coriolis::{free_place, tallest};
use super::figure::{Group, Mark, Moment, Pen, Shape, Tone};
use super::growth::Images;
use super::ink::{FINE, HEAD, LABEL, SMALL, THICK, THICK_HEAD, THIN, dot, head, page};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::polygon::vector_name;
use super::rich::Rich;
use super::scale::APART;
use crate::graphical::construction::{ConstructionLine, Diagram, Label, Vector, VectorKind};

/// Images closer than this are one.
const COINCIDENT: f64 = 0.05;
/// The true multiples at which a detail is drawn.
const MULTIPLES: [f64; 5] = [20.0, 10.0, 5.0, 4.0, 2.0];
/// Radius of a detail at most.
const LARGEST: f64 = 17.0;
/// Blank inside the circle about the points of a spot.
const AROUND: f64 = 1.1;
/// Shorter vectors have no name in a detail either.
const SHORTEST_NAMED: f64 = 3.0;
/// Segments of a circle whose crossing with a line is looked for.
const INSIDE: f64 = 1e-9;

/// A spot of a polygon in which distinct points crowd.
#[derive(Debug, Clone)]
pub(super) struct Spot {
    centre: Point,
    radius: f64,
    multiple: f64,
    /// The names of its points, with their places on the page.
    points: Vec<(Label, Point)>,
    /// What else lies within the circle, and is named beside it too.
    besides: Vec<(Label, Point)>,
}

impl Spot {
    /// Whether this image is drawn in the detail.
    pub(super) fn has(&self, label: Label) -> bool {
        self.points.iter().any(|(own, _)| *own == label)
    }

    /// The point that stood there first.
    pub(super) fn first(&self) -> Option<Label> {
        self.points.first().map(|(label, _)| *label)
    }

    /// Where a name of the spot may stand: outside of its circle.
    pub(super) fn site(&self) -> Site {
        Site::Around { at: self.centre, radius: self.radius + 0.3, toward: None }
    }

    fn to_detail(&self, at: Point) -> Point {
        ((at - self.centre) * self.multiple).to_point()
    }

    /// The piece of a stroke inside the circle, as it lies in the detail; and whether its end is in it.
    fn inside(&self, from: Point, to: Point) -> Option<(Point, Point, bool)> {
        let (d, f) = (to - from, from - self.centre);
        let (a, b, c) = (d.hypot2(), 2.0 * f.dot(d), f.hypot2() - self.radius * self.radius);
        let under = b * b - 4.0 * a * c;
        if a < INSIDE || under <= 0.0 {
            return None;
        }
        let root = under.sqrt();
        let (t0, t1) = (((-b - root) / (2.0 * a)).max(0.0), ((-b + root) / (2.0 * a)).min(1.0));
        (t0 < t1).then(|| (self.to_detail(from.lerp(to, t0)), self.to_detail(from.lerp(to, t1)), t1 == 1.0))
    }
}

/// Where a point is drawn: a vector too short for an arrow is a point, and so is what stands at its ends. A foot stands where
/// its vector begins or ends, an image where the other one is.
pub(super) fn drawn_at(at: Point, polygon: &Diagram) -> Point {
    let foot = |label: Label| matches!(label, Label::Foot { .. });
    let step = |at: Point| {
        polygon.vectors.iter().filter(|v| v.as_point && !v.is_zero).find_map(|v| {
            let (tail, head) = (page(v.from), page(v.to));
            let (moved, stays) = if foot(v.tail) && !foot(v.head) { (tail, head) } else { (head, tail) };
            (moved.distance(at) < COINCIDENT && moved.distance(stays) > COINCIDENT).then_some(stays)
        })
    };
    // A short vector may hang on another one.
    let once = step(at).unwrap_or(at);
    step(once).unwrap_or(once)
}

/// The spots in which points that are not one stand nearer to each other than they may.
pub(super) fn spots(polygon: &Diagram, window: Rect) -> Vec<Spot> {
    let tried = |label: Label| matches!(label, Label::Trial { .. });
    let own = polygon.images.iter().map(|image| (image.label, drawn_at(page(image.at), polygon)));
    let all = std::iter::once((Label::Pole, Point::ZERO)).chain(own);
    let all: Vec<(Label, Point)> = all.filter(|(label, at)| !tried(*label) && window.contains(*at)).collect();
    let mut clusters: Vec<Vec<(Label, Point)>> = Vec::new();
    for own in all.iter().copied() {
        let near = |other: &(Label, Point)| {
            let apart = own.1.distance(other.1);
            apart < APART && apart > COINCIDENT
        };
        let (mut touching, rest): (Vec<_>, Vec<_>) =
            clusters.into_iter().partition(|cluster| cluster.iter().any(near));
        clusters = rest;
        // In the order in which they were found.
        let mut merged = Vec::new();
        touching.iter_mut().for_each(|cluster| merged.append(cluster));
        merged.push(own);
        clusters.push(merged);
    }
    clusters.retain(|cluster| cluster.len() > 1);
    clusters.into_iter().filter_map(|cluster| spot(cluster, &all)).collect()
}

fn spot(points: Vec<(Label, Point)>, all: &[(Label, Point)]) -> Option<Spot> {
    let first = points.first()?.1;
    let bounds = points.iter().fold(Rect::from_points(first, first), |all, (_, at)| all.union_pt(*at));
    let centre = bounds.center();
    let radius = points.iter().map(|(_, at)| at.distance(centre)).fold(0.0, f64::max) + AROUND;
    let multiple = MULTIPLES.into_iter().find(|multiple| radius * multiple <= LARGEST)?;
    let inside = |(label, at): &&(Label, Point)| {
        at.distance(centre) < radius && !points.iter().any(|(own, _)| own == label)
    };
    let besides = all.iter().filter(inside).copied().collect();
    Some(Spot { centre, radius, multiple, points, besides })
}

/// What a detail is called among several; one alone needs no name.
fn letter(index: usize, count: usize) -> Option<Rich> {
    const LETTERS: [&str; 8] = ["I", "II", "III", "IV", "V", "VI", "VII", "VIII"];
    let own = LETTERS.get(index).map_or_else(|| (index + 1).to_string(), |own| (*own).to_owned());
    (count > 1).then(|| Rich::upright(own))
}

fn born(spot: &Spot, births: Option<&Images>) -> Option<Moment> {
    births.and_then(|births| spot.points.iter().map(|(label, _)| births.label(*label)).max())
}

/// The circles about the spots, and the names of their details.
pub(super) fn circles(spots: &[Spot], births: Option<&Images>) -> (Group, Vec<Request>) {
    let mut all = Group::new("spots");
    let mut names = Vec::new();
    for (index, spot) in spots.iter().enumerate() {
        let born = born(spot, births);
        let circle = Shape::Circle { centre: spot.centre, radius: spot.radius };
        all.mark_lived(Mark::stroke(circle, Pen::solid(FINE)).class("spot"), born);
        if let Some(letter) = letter(index, spots.len()) {
            let mut request = Request::new(letter, SMALL, spot.site(), "label detail-name").lived(born);
            request.leader = true;
            names.push(request);
        }
    }
    (all, names)
}

/// Adds the details of a polygon beside it.
pub(super) fn add(
    group: &mut Group,
    spots: &[Spot],
    polygon: &Diagram,
    notation: &Notation<'_>,
    births: Option<&Images>,
) {
    for (index, spot) in spots.iter().enumerate() {
        let letter = letter(index, spots.len());
        let mut own = draw(spot, letter.as_ref(), polygon, notation).lived(born(spot, births));
        let size = own.bounds().unwrap_or(Rect::ZERO);
        let at = free_place(group, size, spot.centre, tallest(notation.scene));
        own.translate(at - size.origin());
        group.group(own);
    }
}

/// A detail with the middle of its spot at the origin, and its caption.
fn draw(spot: &Spot, letter: Option<&Rich>, polygon: &Diagram, notation: &Notation<'_>) -> Group {
    let mut own = Group::new("detail").data("multiple", format!("{}", spot.multiple));
    let radius = spot.radius * spot.multiple;
    let ring = Shape::Circle { centre: Point::ZERO, radius };
    own.mark(Mark::outlined(ring, Pen::solid(FINE), Tone::Paper).class("ring"));
    for line in &polygon.lines {
        if let ConstructionLine::Ray { from, to, .. } = line
            && let [from, to] = [from, to].map(|at| drawn_at(page(*at), polygon))
            && let Some((from, to, _)) = spot.inside(from, to)
        {
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("detail-ray"));
        }
    }
    let whole = |v: &&Vector| matches!(v.kind, VectorKind::Absolute | VectorKind::Relative);
    let parts = polygon.vectors.iter().filter(|v| !whole(v));
    for vector in parts.chain(polygon.vectors.iter().filter(whole)).filter(|v| !v.as_point) {
        let [from, to] = [vector.from, vector.to].map(|at| drawn_at(page(at), polygon));
        let Some((from, to, ends)) = spot.inside(from, to) else { continue };
        let width = if whole(&vector) { THICK } else { THIN };
        let length = from.distance(to);
        let d = (to - from).normalize();
        let full = if width < THICK { HEAD } else { THICK_HEAD };
        let size = if ends { full.min(length / 3.0) } else { 0.0 };
        let neck = to - d * (0.9 * size);
        let mut drawn = Group::new("detail-vector");
        drawn.mark(Mark::stroke(Shape::Line(from, neck), Pen::solid(width)).class("shaft"));
        if ends {
            drawn.mark(head(to, d, size));
        }
        own.group(drawn);
    }
    let mut requests: Vec<Request> = Vec::new();
    let mut names: Vec<(Point, Vec<Label>)> = Vec::new();
    for (label, at) in spot.points.iter().chain(&spot.besides) {
        match names.iter_mut().find(|(p, _)| p.distance(*at) < COINCIDENT) {
            Some((_, labels)) if labels.contains(label) => {}
            Some((_, labels)) => labels.push(*label),
            None => names.push((*at, vec![*label])),
        }
    }
    for (at, labels) in names {
        let at = spot.to_detail(at);
        if labels.contains(&Label::Pole) {
            let circle = Shape::Circle { centre: at, radius: 0.75 };
            own.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).class("detail-point"));
        } else {
            own.mark(dot(at, THICK / 2.0).class("detail-point"));
        }
        let texts: Vec<Rich> = labels.iter().map(|label| notation.image(*label, polygon.kind)).collect();
        let text = Rich::join(&texts, &Rich::upright(","));
        let of = labels.iter().map(|label| notation.image_name(*label, polygon.kind));
        let site = Site::Around { at, radius: 0.9, toward: None };
        let mut request = Request::new(text, LABEL, site, "label image-name").naming(of);
        request.leader = true;
        request.strict = true;
        requests.push(request);
    }
    for vector in named_inside(spot, polygon) {
        let [from, to] = [vector.from, vector.to].map(|at| spot.to_detail(drawn_at(page(at), polygon)));
        if from.distance(to) < SHORTEST_NAMED {
            continue;
        }
        let text = vector_name(vector, polygon, notation);
        let site = Site::Along { from, to };
        let of = notation.quantity_name(vector.quantity);
        let mut request = Request::new(text, SMALL, site, "label vector-name").naming([of]);
        request.leader = true;
        request.strict = true;
        requests.push(request);
    }
    let labels = place(&own, &requests, None);
    own.group(labels);
    let ratio = Rich::upright(format!("{}\u{a0}:\u{a0}1", spot.multiple));
    let caption = match letter {
        Some(letter) => {
            Rich::fill(notation.words.detail_named, &[("name", letter.clone()), ("ratio", ratio)])
        }
        None => Rich::fill(notation.words.detail, &[("ratio", ratio)]),
    };
    let line = caption.set(SMALL);
    let below = own.bounds().map_or(radius, |bounds| bounds.y1) + 4.2;
    line.put(&mut own, Point::new(-line.width / 2.0, below), "label detail-caption");
    own
}

/// The vectors that lie in a spot from end to end: they have their names in the detail.
fn named_inside<'a>(spot: &'a Spot, polygon: &'a Diagram) -> impl Iterator<Item = &'a Vector> {
    polygon.vectors.iter().filter(move |v| !v.as_point && spot.has(v.tail) && spot.has(v.head))
}
