//! Details of a force polygon: where a force is so much smaller than the others that its side is no arrow any more, a circle
//! about the spot and the same sides beside it at a true multiple.

use kurbo::{Point, Rect, Vec2};

use super::coriolis::{free_place, largest};
use super::figure::{Group, Mark, Pen, Shape, Tone};
use super::ink::{FINE, HEAD, SMALL, THICK, THIN, dot, head};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::rich::Rich;

/// The true multiples at which a detail is drawn.
const MULTIPLES: [f64; 5] = [20.0, 10.0, 5.0, 4.0, 2.0];
/// Radius of a detail at most, mm.
const LARGEST: f64 = 17.0;
/// Blank inside the circle about the sides of a spot, mm of the polygon.
const AROUND: f64 = 0.7;
/// A side is an arrow in the detail from this length on, mm.
const ARROW: f64 = 3.0;

/// A side of a polygon.
#[derive(Debug, Clone)]
pub(super) struct Side {
    pub(super) from: Point,
    pub(super) to: Point,
    pub(super) name: Rich,
    pub(super) known: bool,
}

impl Side {
    fn length(&self) -> f64 {
        self.from.distance(self.to)
    }
}

/// Adds a detail for every run of sides that are shorter than this.
pub(super) fn add(group: &mut Group, sides: &[Side], short: f64, notation: &Notation<'_>) {
    let is_short = |side: &Side| side.length() < short;
    for run in sides.chunk_by(|one, other| is_short(one) == is_short(other)) {
        if !run.first().is_some_and(is_short) {
            continue;
        }
        let points = || run.iter().flat_map(|side| [side.from, side.to]);
        let Some(first) = points().next() else { continue };
        let bounds = points().fold(Rect::from_points(first, first), |all, at| all.union_pt(at));
        let centre = bounds.center();
        let radius = points().map(|at| at.distance(centre)).fold(0.0, f64::max) + AROUND;
        let longest = run.iter().map(Side::length).fold(0.0, f64::max);
        let fits = |multiple: &f64| radius * multiple <= LARGEST && longest * multiple >= ARROW;
        let Some(multiple) = MULTIPLES.into_iter().find(fits) else { continue };
        let mut spot = Group::new("detail-spot");
        spot.mark(Mark::stroke(Shape::Circle { centre, radius }, Pen::solid(FINE)).class("ring"));
        group.group(spot);
        let mut own = draw(run, sides, (centre, radius, multiple), notation);
        let size = own.bounds().unwrap_or(Rect::ZERO);
        let at = free_place(group, size, centre, largest(notation.scene));
        own.translate(at - size.origin());
        group.group(own);
    }
}

/// A detail with the middle of its spot at the origin, and its caption.
fn draw(
    run: &[Side],
    all: &[Side],
    (centre, radius, multiple): (Point, f64, f64),
    notation: &Notation<'_>,
) -> Group {
    let mut own = Group::new("detail").data("multiple", format!("{multiple}"));
    let edge = radius * multiple;
    let ring = Shape::Circle { centre: Point::ORIGIN, radius: edge };
    own.mark(Mark::outlined(ring, Pen::solid(FINE), Tone::Paper).class("ring"));
    let enlarged = |at: Point| ((at - centre) * multiple).to_point();
    let within = |side: &Side| run.iter().any(|short| short.from == side.from && short.to == side.to);
    // What comes to the spot and goes from it, as far as the circle.
    for side in all.iter().filter(|side| !within(side)) {
        for (end, other) in [(side.from, side.to), (side.to, side.from)] {
            if end.distance(centre) < radius {
                let along = (other - end).normalize();
                let at = enlarged(end);
                let from = at.to_vec2();
                let before = from.dot(along);
                let half = libm::sqrt((edge * edge - from.hypot2() + before * before).max(0.0));
                let reach = half - before;
                let pen = Pen::solid(if side.known { THICK } else { THIN });
                own.mark(Mark::stroke(Shape::Line(at, at + along * reach), pen).class("detail-ray"));
            }
        }
    }
    let mut requests: Vec<Request> = Vec::new();
    for side in run.iter().filter(|side| side.length() > 0.0) {
        let (from, to) = (enlarged(side.from), enlarged(side.to));
        let mut drawn = Group::new("detail-vector");
        if from.distance(to) < 1.0 {
            drawn.mark(dot(to, 0.45).class("detail-point"));
        } else {
            let along: Vec2 = (to - from).normalize();
            let size = HEAD.min(from.distance(to) / 2.0);
            let width = if side.known { THICK } else { THIN };
            let shaft = Shape::Line(from, to - along * (0.9 * size));
            drawn.mark(Mark::stroke(shaft, Pen::solid(width)).class("shaft"));
            drawn.mark(head(to, along, size));
        }
        own.group(drawn);
        let site = Site::Along { from, to };
        let mut request = Request::new(side.name.clone(), SMALL, site, "label vector-name");
        request.leader = true;
        requests.push(request);
    }
    let labels = place(&own, &requests, None);
    own.group(labels);
    let ratio = Rich::upright(format!("{multiple}\u{a0}:\u{a0}1"));
    let line = Rich::fill(notation.words.detail, &[("ratio", ratio)]).set(SMALL);
    let below = own.bounds().map_or(edge, |bounds| bounds.y1) + 4.2;
    line.put(&mut own, Point::new(-line.width / 2.0, below), "label detail-caption");
    own
}
