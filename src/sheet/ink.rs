//! Strokes that several drawings share: arrows, hatching, right-angle marks.

use kurbo::{Point, Vec2};

use super::figure::{Group, Mark, Pen, Shape, Tone, on_circle};

/// Visible links and whole vectors.
pub const THICK: f64 = 0.5;
/// Components, symbols, dimensions.
pub const THIN: f64 = 0.25;
/// Construction lines and hatching.
pub const FINE: f64 = 0.18;
/// Type size of labels.
pub const LABEL: f64 = 4.0;
/// Type size of secondary labels.
pub const SMALL: f64 = 3.3;
/// Length of an arrowhead; it is three times as long as wide.
pub const HEAD: f64 = 2.5;
/// Strokes of one hatching, however long its line.
pub const MOST_HATCHES: f64 = 1_000.0;
/// Length of the arrowhead of a thick vector.
pub const THICK_HEAD: f64 = 3.0;

/// A place of a diagram (mm, y up) as a point of the page (y down).
#[must_use]
pub fn page(mm: [f64; 2]) -> Point {
    Point::new(mm[0], -mm[1])
}

/// A filled arrowhead with its tip at `tip`, pointing along `direction` (a unit vector).
#[must_use]
pub fn head(tip: Point, direction: Vec2, length: f64) -> Mark {
    let back = tip - direction * length;
    let side = Vec2::new(-direction.y, direction.x) * (length / 6.0);
    Mark::area(Shape::Polygon(vec![tip, back + side, back - side]), Tone::Ink).class("head")
}

/// A vector: its tail is the first point of the shaft, its tip the first point of the head.
pub fn arrow(group: &mut Group, from: Point, to: Point, width: f64) {
    let d = to - from;
    let length = d.hypot();
    if length <= 0.0 {
        return;
    }
    let direction = d / length;
    let full = if width < THICK { HEAD } else { THICK_HEAD };
    let head_length = full.min(length / 3.0);
    // A shaft as wide as its own head would hide it.
    let width = width.min(head_length / 4.0);
    let neck = to - direction * (head_length * 0.9);
    group.mark(Mark::stroke(Shape::Line(from, neck), Pen::solid(width)).class("shaft").precise());
    group.mark(head(to, direction, head_length).precise());
}

/// An arc that ends in an arrowhead.
pub fn arc_arrow(group: &mut Group, centre: Point, radius: f64, start: f64, sweep: f64, width: f64) {
    let length = (HEAD * 0.9).min(radius * sweep.abs() / 2.0);
    // The head is a chord: turned back by half of what it spans it lies along the arc.
    let span = length / radius;
    let end = start + sweep;
    let sign = sweep.signum();
    let shaft = Shape::Arc { centre, radius, start, sweep: sweep - sign * span * 0.8 };
    group.mark(Mark::stroke(shaft, Pen::solid(width)).class("shaft"));
    let tip = on_circle(centre, radius, end);
    let (sin, cos) = libm::sincos(end - sign * span / 2.0);
    let direction = Vec2::new(-sin, -cos) * sign;
    group.mark(head(tip, direction, length));
}

/// Strokes at 45° below a base line from `a` to `b`, on its right-hand side going from a to b as seen
/// on the page with y down.
pub fn hatch_below(group: &mut Group, a: Point, b: Point) {
    let d = b - a;
    let length = d.hypot();
    if length <= 0.0 {
        return;
    }
    let along = d / length;
    let below = Vec2::new(-along.y, along.x);
    let step = 1.5;
    let count = (length / step).floor().clamp(2.0, MOST_HATCHES);
    let step = length / count;
    let depth = 1.5;
    for i in 0..count as usize {
        let top = a + along * (step * (i as f64 + 1.0));
        let foot = top + (below - along) * depth;
        group.mark(Mark::stroke(Shape::Line(top, foot), Pen::solid(FINE)).class("hatch"));
    }
}

/// Light parallel strokes at 45° inside a convex outline.
pub fn hatch_inside(group: &mut Group, corners: &[Point], spacing: f64) {
    let normal = Vec2::new(1.0, 1.0) * std::f64::consts::FRAC_1_SQRT_2;
    let along = Vec2::new(normal.y, -normal.x);
    let heights = || corners.iter().map(|p| p.to_vec2().dot(normal));
    let (Some(least), Some(most)) = (heights().reduce(f64::min), heights().reduce(f64::max)) else { return };
    let count = ((most - least) / spacing).floor().min(400.0);
    for i in 1..=count as usize {
        let h = least + spacing * (i as f64 - 0.5);
        let mut ends: Vec<f64> = Vec::new();
        for (p, q) in corners.iter().zip(corners.iter().cycle().skip(1)) {
            let (hp, hq) = (p.to_vec2().dot(normal) - h, q.to_vec2().dot(normal) - h);
            if (hp > 0.0) != (hq > 0.0) {
                ends.push(p.lerp(*q, hp / (hp - hq)).to_vec2().dot(along));
            }
        }
        ends.sort_by(f64::total_cmp);
        if let (Some(first), Some(last)) = (ends.first(), ends.last())
            && last - first > 0.6
        {
            let at = |s: f64| (normal * h + along * s).to_point();
            let stroke = Shape::Line(at(first + 0.2), at(last - 0.2));
            group.mark(Mark::stroke(stroke, Pen::solid(0.13)).class("hatch"));
        }
    }
}

/// A small square in the corner where two directions meet at a right angle.
pub fn right_angle(group: &mut Group, corner: Point, one: Vec2, other: Vec2, size: f64) {
    let (one, other) = (one.normalize() * size, other.normalize() * size);
    let shape = Shape::Polyline(vec![corner + one, corner + one + other, corner + other]);
    group.mark(Mark::stroke(shape, Pen::solid(FINE)).class("right-angle"));
}

/// A filled dot.
#[must_use]
pub fn dot(centre: Point, radius: f64) -> Mark {
    Mark::area(Shape::Circle { centre, radius }, Tone::Ink)
}

/// Convex hull, counter-clockwise in the coordinates given (Andrew's monotone chain).
#[must_use]
pub fn hull(points: &[Point]) -> Vec<Point> {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    sorted.dedup();
    if sorted.len() < 3 {
        return sorted;
    }
    let half = |points: &mut dyn Iterator<Item = Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while let [.., a, b] = chain[..]
                && (b - a).cross(p - b) <= 0.0
            {
                chain.pop();
            }
            chain.push(p);
        }
        chain.pop();
        chain
    };
    let mut lower = half(&mut sorted.iter().copied());
    lower.append(&mut half(&mut sorted.iter().rev().copied()));
    lower
}

/// A rectangle's corners, turned.
#[must_use]
pub fn turned_rect(centre: Point, along: Vec2, half_length: f64, half_width: f64) -> Vec<Point> {
    let across = Vec2::new(-along.y, along.x) * half_width;
    let along = along * half_length;
    vec![centre + along + across, centre - along + across, centre - along - across, centre + along - across]
}
