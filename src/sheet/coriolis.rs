//! The small figure beside an acceleration polygon that shows the sense of Coriolis: the sliding velocity
//! turned by 90° in the sense of the ω of the link that carries the guide.

use kurbo::{Point, Rect, Vec2};

use super::compose::free_paper;
use super::figure::{Group, Mark, Pen, Shape, on_circle};
use super::growth::Images;
use super::ink::{FINE, SMALL, THIN, arc_arrow, arrow, dot, page};
use super::labels::{Obstacles, Request, Site, place};
use super::notation::Notation;
use crate::graphical::construction::{Act, Calculation, Diagram, Step, VectorKind};
use crate::mechanism::LinkId;
use crate::mechanism::quantity::Quantity;
use crate::scene::Scene;

/// Length of both arrows.
const ARM: f64 = 9.0;
/// Radius of the arrow of ω between them.
const TURN: f64 = 4.6;
/// Blank inside the frame, and between it and other ink.
const BLANK: f64 = 1.4;
/// From place to place of the search.
const STEP: f64 = 1.5;
/// A millimetre of width is dearer than one of height: panels share rows.
const WIDTH_COST: f64 = 3.0;
/// What a millimetre costs by which a drawing outgrows its page.
const BEYOND: f64 = 30.0;
/// Height of a page that is not a drawing's: margins, headings and the caption, mm.
const NOT_DRAWN: f64 = 43.0;

/// Adds one small figure for each Coriolis vector that is long enough to be seen, where the drawing
/// leaves room, else where it makes the drawing grow least.
pub fn add_insets(
    group: &mut Group,
    polygon: &Diagram,
    steps: &[Step],
    notation: &Notation<'_>,
    births: Option<&Images>,
) {
    let mut shown: Vec<Quantity> = Vec::new();
    let all = polygon.vectors.iter().enumerate();
    for (index, vector) in all.filter(|(_, v)| v.kind == VectorKind::Coriolis && !v.as_point) {
        let Some((link, slip, omega)) = calculated(steps, vector.quantity) else { continue };
        let d = page(vector.to) - page(vector.from);
        if omega == 0.0 || d.hypot() <= 0.0 || shown.contains(&vector.quantity) {
            continue;
        }
        shown.push(vector.quantity);
        let mut inset = inset(d.normalize(), vector.quantity, (link, slip, omega), notation);
        let middle = page(vector.from).midpoint(page(vector.to));
        let size = inset.bounds().unwrap_or(Rect::ZERO);
        let at = free_place(group, size, middle, largest(notation.scene));
        inset.translate(at - size.origin());
        group.group(inset.lived(births.and_then(|b| b.vectors.get(index)).map(|life| life.born)));
    }
}

/// The link that carries the guide, the sliding velocity and ω of a Coriolis acceleration.
fn calculated(steps: &[Step], wanted: Quantity) -> Option<(LinkId, Quantity, f64)> {
    steps.iter().flat_map(|step| &step.acts).find_map(|act| match act {
        Act::Calculate(Calculation::Coriolis { quantity, link, slip, omega, .. }) if *quantity == wanted => {
            Some((*link, *slip, *omega))
        }
        _ => None,
    })
}

/// The framed figure with the common tail of both arrows at the origin; `toward` is Coriolis' direction.
fn inset(
    toward: Vec2,
    quantity: Quantity,
    (link, slip, omega): (LinkId, Quantity, f64),
    notation: &Notation<'_>,
) -> Group {
    let mut own = Group::new("coriolis-rule").data("quantity", notation.quantity_name(quantity));
    // On the page y runs down: a quarter turn against ω leads back to the sliding velocity.
    let sign = omega.signum();
    let along = Vec2::new(-toward.y, toward.x) * sign;
    let tail = Point::ORIGIN;
    arrow(&mut own, tail, tail + along * ARM, THIN);
    arrow(&mut own, tail, tail + toward * ARM, THIN);
    let start = libm::atan2(-along.y, along.x);
    arc_arrow(&mut own, tail, TURN, start, sign * std::f64::consts::FRAC_PI_2, FINE);
    own.mark(dot(tail, 0.4));
    let between = start + sign * std::f64::consts::FRAC_PI_4;
    let label = |quantity, site| {
        Request::new(notation.symbol(quantity, false), SMALL * 0.95, site, "label coriolis-name")
    };
    let beyond = |way: Vec2| {
        let at = tail + way * ARM;
        Site::Around { at, radius: 0.2, toward: Some(libm::atan2(-way.y, way.x)) }
    };
    let middle = on_circle(tail, TURN, between);
    let requests = [
        label(slip, beyond(along)),
        label(quantity, beyond(toward)),
        label(Quantity::Omega(link), Site::Around { at: middle, radius: 0.2, toward: Some(between) }),
    ];
    let labels = place(&own, &requests, None);
    own.group(labels);
    let ink = own.bounds().unwrap_or(Rect::ZERO).inflate(BLANK, BLANK);
    let corners = [(ink.x0, ink.y0), (ink.x1, ink.y0), (ink.x1, ink.y1), (ink.x0, ink.y1)];
    let frame = Shape::Polygon(corners.map(Point::from).to_vec());
    own.mark(Mark::stroke(frame, Pen::solid(FINE)).class("frame"));
    own
}

/// How tall a drawing with all that stands beside it may be, mm.
pub(super) fn largest(scene: &Scene) -> (f64, f64) {
    let (width, height) = free_paper(scene);
    (width, height - NOT_DRAWN)
}

/// Where a box of this size disturbs least: inside the drawing's own box if there is room, near `wish`; beside the drawing
/// rather than above or below it where that would outgrow the paper, and the other way round.
pub(super) fn free_place(group: &Group, size: Rect, wish: Point, (widest, tallest): (f64, f64)) -> Point {
    let ink = group.bounds().unwrap_or(Rect::ZERO);
    let obstacles = Obstacles::of(group);
    let (w, h) = (size.width(), size.height());
    let gap = 2.0 * BLANK;
    let columns = ((ink.width() + w + 2.0 * gap) / STEP).ceil().min(400.0) as i32;
    let rows = ((ink.height() + h + 2.0 * gap) / STEP).ceil().min(400.0) as i32;
    let mut best = (f64::INFINITY, Point::new(ink.x0, ink.y1 + gap));
    for row in 0..=rows {
        for column in 0..=columns {
            let x = ink.x0 - w - gap + f64::from(column) * STEP;
            let y = ink.y0 - h - gap + f64::from(row) * STEP;
            let own = Rect::new(x, y, x + w, y + h);
            let both = ink.union(own);
            let growth = WIDTH_COST * (both.width() - ink.width()) + (both.height() - ink.height());
            let beyond = (both.height() - tallest.max(ink.height())).max(0.0)
                + (both.width() - widest.max(ink.width())).max(0.0);
            let cost = growth + 0.05 * own.center().distance(wish) + BEYOND * beyond;
            if cost < best.0 && obstacles.is_free(own.inflate(BLANK, BLANK)) {
                best = (cost, own.origin());
            }
        }
    }
    best.1
}
