//! Details of a polygon, and of a figure of centres: where points crowd, a circle about the spot and the same ink beside it at a
//! true multiple.

use kurbo::{Point, Rect};

use super::coriolis::{free_place, largest};
use super::figure::{Group, Life, Mark, Moment, Node, Pen, Shape, Tone};
use super::growth::Images;
use super::ink::{FINE, HEAD, LABEL, SMALL, THICK, THICK_HEAD, THIN, dot, head, page};
use super::labels::{Request, Site, pieces, place};
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

/// A spot of a drawing in which distinct points crowd.
#[derive(Debug, Clone)]
pub(super) struct Spot<T = Label> {
    centre: Point,
    radius: f64,
    multiple: f64,
    /// The names of its points, with their places on the page.
    points: Vec<(T, Point)>,
    /// What else lies within the circle, and is named beside it too.
    besides: Vec<(T, Point)>,
}

impl<T: Copy + PartialEq> Spot<T> {
    /// Whether this image is drawn in the detail.
    pub(super) fn has(&self, label: T) -> bool {
        self.points.iter().any(|(own, _)| *own == label)
    }

    /// The point that stood there first.
    pub(super) fn first(&self) -> Option<T> {
        self.points.first().map(|(label, _)| *label)
    }

    /// Where a name of the spot may stand: outside of its circle.
    pub(super) fn site(&self) -> Site {
        Site::Around { at: self.centre, radius: self.radius + 0.3, toward: None }
    }

    /// All that is named in the detail, each with its place there.
    pub(super) fn named(&self) -> impl Iterator<Item = (T, Point)> + '_ {
        self.points.iter().chain(&self.besides).map(|(own, at)| (*own, self.to_detail(*at)))
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
    crowded(&all.filter(|(label, at)| !tried(*label) && window.contains(*at)).collect::<Vec<_>>())
}

/// The spots in which some of these points stand nearer to each other than they may.
pub(super) fn crowded<T: Copy + PartialEq>(all: &[(T, Point)]) -> Vec<Spot<T>> {
    let mut clusters: Vec<Vec<(T, Point)>> = Vec::new();
    for own in all.iter().copied() {
        let near = |other: &(T, Point)| {
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
    clusters.into_iter().filter_map(|cluster| spot(cluster, all)).collect()
}

fn spot<T: Copy + PartialEq>(points: Vec<(T, Point)>, all: &[(T, Point)]) -> Option<Spot<T>> {
    let first = points.first()?.1;
    let bounds = points.iter().fold(Rect::from_points(first, first), |all, (_, at)| all.union_pt(*at));
    let centre = bounds.center();
    let radius = points.iter().map(|(_, at)| at.distance(centre)).fold(0.0, f64::max) + AROUND;
    let multiple = MULTIPLES.into_iter().find(|multiple| radius * multiple <= LARGEST)?;
    let inside = |(label, at): &&(T, Point)| {
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

/// A spot is one as soon as a second point stands there.
pub(super) fn born(spot: &Spot, births: &Images) -> Option<Moment> {
    let mut all: Vec<Moment> = spot.points.iter().map(|(label, _)| births.label(*label)).collect();
    all.sort();
    all.get(1).copied()
}

/// The circles about the spots, and the names of their details.
pub(super) fn circles<T: Copy + PartialEq>(
    spots: &[Spot<T>],
    born: impl Fn(&Spot<T>) -> Option<Moment>,
) -> (Group, Vec<Request>) {
    let mut all = Group::new("spots");
    let mut names = Vec::new();
    for (index, spot) in spots.iter().enumerate() {
        let born = born(spot);
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
        let own = draw(spot, (index, spots.len()), polygon, notation, births);
        put(group, own, spot.centre, notation);
    }
}

/// Adds the details of another drawing beside it: its own ink inside each spot, symbols of points in their size, and names.
pub(super) fn add_of_ink<T: Copy + PartialEq>(
    group: &mut Group,
    spots: &[Spot<T>],
    notation: &Notation<'_>,
    name: impl Fn(T, Point) -> Request,
) {
    let drawn = group.clone();
    for (index, spot) in spots.iter().enumerate() {
        let mut own = headed(spot);
        ring(&mut own, spot);
        let (mut strokes, mut symbols) = (Vec::new(), Vec::new());
        ink_inside(spot, &drawn, &mut strokes, &mut symbols);
        strokes.into_iter().chain(symbols).for_each(|mark| own.mark(mark));
        let names: Vec<Request> = spot.named().map(|(of, at)| name(of, at)).collect();
        let labels = place(&own, &names, None);
        own.group(labels);
        let bottom = own.bounds().unwrap_or(Rect::ZERO).y1;
        caption(&mut own, bottom, spot, (index, spots.len()), notation);
        put(group, own, spot.centre, notation);
    }
}

/// The straight strokes and the symbols of points of a drawing inside a spot, as they lie in its detail.
fn ink_inside<T: Copy + PartialEq>(
    spot: &Spot<T>,
    group: &Group,
    strokes: &mut Vec<Mark>,
    symbols: &mut Vec<Mark>,
) {
    /// A larger circle is no symbol of a point.
    const SYMBOL: f64 = 2.0;
    for node in &group.children {
        let mark = match node {
            Node::Group(group) if matches!(group.class.as_str(), "labels" | "spots") => continue,
            Node::Group(group) => {
                ink_inside(spot, group, strokes, symbols);
                continue;
            }
            Node::Mark(mark) => mark,
            Node::Text(_) => continue,
        };
        let mut line = |from: Point, to: Point| {
            if let Some((from, to, _)) = spot.inside(from, to) {
                let shape = Shape::Line(from, to);
                strokes.push(Mark { shape, class: "detail-ray", precise: false, ..mark.clone() });
            }
        };
        match &mark.shape {
            Shape::Line(from, to) => line(*from, *to),
            Shape::Polyline(points) => points.windows(2).for_each(|ends| line(ends[0], ends[1])),
            Shape::Circle { centre, radius }
                if *radius <= SYMBOL && centre.distance(spot.centre) < spot.radius =>
            {
                let shape = Shape::Circle { centre: spot.to_detail(*centre), radius: *radius };
                symbols.push(Mark { shape, class: "detail-point", precise: false, ..mark.clone() });
            }
            _ => {}
        }
    }
}

/// Puts a detail beside its drawing.
fn put(group: &mut Group, mut own: Group, wish: Point, notation: &Notation<'_>) {
    let size = own.bounds().unwrap_or(Rect::ZERO);
    let at = free_place(group, size, wish, largest(notation.scene));
    own.translate(at - size.origin());
    group.group(own);
}

fn headed<T>(spot: &Spot<T>) -> Group {
    Group::new("detail").data("multiple", format!("{}", spot.multiple))
}

/// The circle of a detail, with the middle of its spot at the origin.
fn ring<T>(own: &mut Group, spot: &Spot<T>) {
    let ring = Shape::Circle { centre: Point::ZERO, radius: spot.radius * spot.multiple };
    own.mark(Mark::outlined(ring, Pen::solid(FINE), Tone::Paper).class("ring"));
}

/// What stands below a detail, the one of this number among so many.
fn caption<T>(
    into: &mut Group,
    bottom: f64,
    spot: &Spot<T>,
    (index, count): (usize, usize),
    notation: &Notation<'_>,
) {
    let ratio = Rich::upright(format!("{}\u{a0}:\u{a0}1", spot.multiple));
    let caption = match letter(index, count) {
        Some(letter) => Rich::fill(notation.words.detail_named, &[("name", letter), ("ratio", ratio)]),
        None => Rich::fill(notation.words.detail, &[("ratio", ratio)]),
    };
    let line = caption.set(SMALL);
    line.put(into, Point::new(-line.width / 2.0, bottom + 4.2), "label detail-caption");
}

/// A detail with the middle of its spot at the origin, and its caption. Its ink comes onto the paper when that of the polygon
/// does, but not before the spot is one.
fn draw(
    spot: &Spot,
    place_of: (usize, usize),
    polygon: &Diagram,
    notation: &Notation<'_>,
    births: Option<&Images>,
) -> Group {
    let begun = births.and_then(|births| born(spot, births));
    let later = |life: Life| Life { born: begun.map_or(life.born, |begun| begun.max(life.born)), ..life };
    let of_label = |label: Label| births.map(|births| later(births.label(label).into()));
    let of_vector = |index: usize| births.and_then(|births| births.vectors.get(index).copied()).map(later);
    let mut own = headed(spot);
    let mut circle = Group::default().lived(begun);
    ring(&mut circle, spot);
    own.group(circle);
    for (index, line) in polygon.lines.iter().enumerate() {
        if let ConstructionLine::Ray { from, to, .. } = line
            && let [from, to] = [from, to].map(|at| drawn_at(page(*at), polygon))
            && let Some((from, to, _)) = spot.inside(from, to)
        {
            let life = births.and_then(|births| births.lines.get(index).copied()).map(Life::from).map(later);
            own.mark_lived(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("detail-ray"), life);
        }
    }
    let whole = |v: &Vector| matches!(v.kind, VectorKind::Absolute | VectorKind::Relative);
    let all = || polygon.vectors.iter().enumerate();
    let parts = all().filter(|(_, v)| !whole(v));
    for (index, vector) in parts.chain(all().filter(|(_, v)| whole(v))).filter(|(_, v)| !v.as_point) {
        let [from, to] = [vector.from, vector.to].map(|at| drawn_at(page(at), polygon));
        let Some((from, to, ends)) = spot.inside(from, to) else { continue };
        let width = if whole(vector) { THICK } else { THIN };
        let length = from.distance(to);
        let d = (to - from).normalize();
        let full = if width < THICK { HEAD } else { THICK_HEAD };
        let size = if ends { full.min(length / 3.0) } else { 0.0 };
        let neck = to - d * (0.9 * size);
        let mut drawn = Group::new("detail-vector").lived(of_vector(index));
        drawn.mark(Mark::stroke(Shape::Line(from, neck), Pen::solid(width)).class("shaft"));
        if ends {
            drawn.mark(head(to, d, size));
        }
        own.group(drawn);
    }
    let mut requests: Vec<Request> = Vec::new();
    let mut names: Vec<(Point, Vec<Label>)> = Vec::new();
    for (label, at) in spot.named() {
        match names.iter_mut().find(|(p, _)| p.distance(at) < COINCIDENT * spot.multiple) {
            Some((_, labels)) if labels.contains(&label) => {}
            Some((_, labels)) => labels.push(label),
            None => names.push((at, vec![label])),
        }
    }
    for (at, labels) in names {
        let first = labels.iter().filter_map(|label| of_label(*label)).min_by_key(|life| life.born);
        if labels.contains(&Label::Pole) {
            let circle = Shape::Circle { centre: at, radius: 0.75 };
            let circle = Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).class("detail-point");
            own.mark_lived(circle, first);
        } else {
            own.mark_lived(dot(at, THICK / 2.0).class("detail-point"), first);
        }
        let texts: Vec<Rich> = labels.iter().map(|label| notation.image(*label, polygon.kind)).collect();
        let text = Rich::join(&texts, &Rich::upright(","));
        let of = labels.iter().map(|label| notation.image_name(*label, polygon.kind));
        let site = Site::Around { at, radius: 0.9, toward: None };
        let mut request = Request::new(text, LABEL, site, "label image-name").naming(of).lived(first);
        if births.is_some() {
            let apart = labels.iter().zip(&texts).filter_map(|(label, text)| {
                Some((text.clone(), vec![notation.image_name(*label, polygon.kind)], of_label(*label)?))
            });
            request = request.in_pieces(pieces(apart.collect(), &Rich::upright(",")));
        }
        request.leader = true;
        request.strict = true;
        requests.push(request);
    }
    for (index, vector) in named_inside(spot, polygon) {
        let [from, to] = [vector.from, vector.to].map(|at| spot.to_detail(drawn_at(page(at), polygon)));
        if from.distance(to) < SHORTEST_NAMED {
            continue;
        }
        let text = vector_name(vector, polygon, notation);
        let site = Site::Along { from, to };
        let of = notation.quantity_name(vector.quantity);
        let mut request =
            Request::new(text, SMALL, site, "label vector-name").naming([of]).lived(of_vector(index));
        request.leader = true;
        request.strict = true;
        requests.push(request);
    }
    let labels = place(&own, &requests, None);
    own.group(labels);
    let mut below = Group::default().lived(begun);
    caption(&mut below, own.bounds().unwrap_or(Rect::ZERO).y1, spot, place_of, notation);
    own.group(below);
    own
}

/// The vectors that lie in a spot from end to end: they have their names in the detail.
fn named_inside<'a>(spot: &'a Spot, polygon: &'a Diagram) -> impl Iterator<Item = (usize, &'a Vector)> {
    let all = polygon.vectors.iter().enumerate();
    all.filter(move |(_, v)| !v.as_point && spot.has(v.tail) && spot.has(v.head))
}
