//! The geometric test that no text touches ink or other text.

use kurbo::{Point, Rect};

use super::figure::{Figure, Group, Mark, Node, Shape, Text, Tone};
use super::grid::{Grid, Met};

/// A text that touches something.
#[derive(Debug, Clone, PartialEq)]
pub struct Overlap {
    /// The text.
    pub text: String,
    /// What it touches: another text, or the class of the ink.
    pub with: String,
    /// Where, mm on the page.
    pub at: Point,
}

/// Every text of the figure that touches ink, another text or the edge of the paper.
#[must_use]
pub fn overlaps(figure: &Figure) -> Vec<Overlap> {
    let page = Rect::new(0.0, 0.0, figure.width, figure.height);
    overlaps_in(&figure.root, Some(page))
}

/// Every text of the group that touches ink, another text or the edge of `page`.
#[must_use]
pub fn overlaps_in(group: &Group, page: Option<Rect>) -> Vec<Overlap> {
    let mut texts: Vec<&Text> = Vec::new();
    let mut marks: Vec<&Mark> = Vec::new();
    group.walk(&mut |node| match node {
        Node::Text(text) => texts.push(text),
        Node::Mark(mark) => marks.push(mark),
        Node::Group(_) => {}
    });
    let boxes: Vec<(usize, Rect)> = texts
        .iter()
        .enumerate()
        .flat_map(|(i, text)| text.boxes().into_iter().map(move |b| (i, b)))
        .collect();
    let inks: Vec<(&Mark, Rect)> =
        marks.into_iter().filter(|m| !m.backdrop).map(|m| (m, m.bounds())).collect();
    let mut found = Vec::new();
    let mut report = |i: usize, with: String, at: Rect| {
        found.push(Overlap { text: texts[i].content(), with, at: at.center() });
    };
    let area = boxes.iter().map(|(_, b)| *b).chain(inks.iter().map(|(_, b)| *b)).reduce(|a, b| a.union(b));
    let area = area.unwrap_or(Rect::ZERO);
    let (mut texts_near, mut inks_near) = (Grid::new(area), Grid::new(area));
    for (n, (_, own)) in boxes.iter().enumerate() {
        texts_near.add(n, *own);
    }
    for (n, (mark, own)) in inks.iter().enumerate() {
        match &mark.shape {
            Shape::Line(a, b) => inks_near.add_stroke(n, *a, *b, mark.pen.map_or(0.0, |pen| pen.width / 2.0)),
            _ => inks_near.add(n, *own),
        }
    }
    let (mut near, mut met) = (Vec::new(), Met::default());
    for (n, (i, own)) in boxes.iter().enumerate() {
        if let Some(page) = page
            && !page.contains_rect(*own)
        {
            report(*i, "the edge of the paper".to_owned(), *own);
        }
        texts_near.near(*own, boxes.len(), &mut met, &mut near, |k| k > n);
        for (j, other) in near.iter().map(|k| &boxes[*k]) {
            if i != j && !own.intersect(*other).is_zero_area() {
                report(*i, format!("text {:?}", texts[*j].content()), *own);
            }
        }
        inks_near.near(*own, inks.len(), &mut met, &mut near, |_| true);
        for (mark, ink) in near.iter().map(|k| &inks[*k]) {
            // A level stroke without width has a box without area, so the plain test, not an intersection.
            let apart = ink.x0 > own.x1 || ink.x1 < own.x0 || ink.y0 > own.y1 || ink.y1 < own.y0;
            if !apart && touches(mark, *own) {
                report(*i, format!("ink {:?}", mark.class), *own);
            }
        }
    }
    found
}

/// Whether the ink of a mark meets a box.
fn touches(mark: &Mark, own: Rect) -> bool {
    let half = mark.pen.map_or(0.0, |pen| pen.width / 2.0);
    let grown = own.inflate(half, half);
    mark.shape.outline().iter().any(|(a, b)| clip(*a, *b, grown).is_some())
        || (mark.fill == Some(Tone::Ink) && encloses(&mark.shape, own.center()))
}

fn encloses(shape: &Shape, p: Point) -> bool {
    let mut inside = false;
    for (a, b) in shape.outline() {
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            inside = !inside;
        }
    }
    inside && !matches!(shape, Shape::Line(..) | Shape::Polyline(_) | Shape::Arc { .. })
}

/// A stroke as far as it lies in a box, however far away an end is; itself where it leaves the box nowhere.
#[must_use]
pub fn part_inside(a: Point, b: Point, r: Rect) -> Option<(Point, Point)> {
    if r.contains(a) && r.contains(b) {
        return Some((a, b));
    }
    // Points of a long stroke are found from its nearer end: shares of its length would carry its rounding.
    let middle = r.center();
    let far = |p: Point| (p - middle).hypot();
    let turned = far(a) < far(b);
    let (from, near) = if turned { (b, a) } else { (a, b) };
    let reach = far(near) + r.width() + r.height();
    let d = from - near;
    let cut = if d.hypot() > reach { near + d / d.hypot() * reach } else { from };
    let (t0, t1) = clip(cut, near, r)?;
    let (from, near) = (cut.lerp(near, t0), if t1 < 1.0 { cut.lerp(near, t1) } else { near });
    Some(if turned { (near, from) } else { (from, near) })
}

/// The part of a stroke inside a box, as parameters along it (Liang and Barsky).
#[must_use]
pub fn clip(a: Point, b: Point, r: Rect) -> Option<(f64, f64)> {
    let d = b - a;
    let (mut t0, mut t1) = (0.0_f64, 1.0_f64);
    for (p, q) in [(-d.x, a.x - r.x0), (d.x, r.x1 - a.x), (-d.y, a.y - r.y0), (d.y, r.y1 - a.y)] {
        if p == 0.0 {
            if q < 0.0 {
                return None;
            }
        } else {
            let t = q / p;
            if p < 0.0 {
                t0 = t0.max(t);
            } else {
                t1 = t1.min(t);
            }
            if t0 > t1 {
                return None;
            }
        }
    }
    Some((t0, t1))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::figure::Pen;
    use crate::sheet::rich::Rich;

    fn group_with(shape: Shape) -> Group {
        let mut group = Group::default();
        Rich::upright("H").set(10.0).put(&mut group, Point::new(0.0, 0.0), "");
        group.mark(Mark::stroke(shape, Pen::solid(0.5)));
        group
    }

    #[test]
    fn a_stroke_through_a_letter_is_reported_and_one_beside_it_is_not() {
        let through = Shape::Line(Point::new(-5.0, -3.0), Point::new(20.0, -3.0));
        assert_eq!(overlaps_in(&group_with(through), None).len(), 1);
        let below = Shape::Line(Point::new(-5.0, 0.3), Point::new(20.0, 0.3));
        assert!(overlaps_in(&group_with(below), None).is_empty());
        let grazing = Shape::Line(Point::new(-5.0, 0.2), Point::new(20.0, 0.2));
        assert_eq!(overlaps_in(&group_with(grazing), None).len(), 1);
    }

    #[test]
    fn the_edge_of_the_paper_counts() {
        let far = Shape::Line(Point::new(50.0, 50.0), Point::new(60.0, 50.0));
        let page = Rect::new(0.0, 0.0, 100.0, 100.0);
        assert_eq!(overlaps_in(&group_with(far), Some(page)).len(), 1);
    }
}
