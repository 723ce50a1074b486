//! A student's polygons over the right ones.

use kurbo::{Point, Rect, Vec2};

use super::compose::{cut, localised};
use super::feet::told_apart;
use super::figure::{Dash, Figure, Group, Mark, Node, Pen, Shape};
use super::ink::{FINE, HEAD, SMALL, THIN, head, page};
use super::notation::Notation;
use super::polygon;
use super::rich::Rich;
use super::words::Language;
use crate::graphical::construction::{Construction, Diagram, Label, Mm2, VectorKind};
use crate::mechanism::quantity::DiagramKind;
use crate::scene::Scene;

/// A vector of the student that lies nearer to the right one than this (mm) is not drawn twice.
const SAME: f64 = 0.5;
/// Radius of the circle about a fault, mm.
const CIRCLE: f64 = 4.5;
/// Blank between two polygons one below the other, and between a polygon and its caption, mm.
const BLANK: f64 = 8.0;
/// Blank between two polygons side by side, mm.
const BETWEEN: f64 = 14.0;
/// Room of a page for them, mm.
const PAGE: (f64, f64) = (180.0, 150.0);
/// From one line of a caption to the next, mm.
const LINE: f64 = 4.6;
/// Captions are not set narrower than this, mm.
const NARROWEST: f64 = 80.0;
/// How far a letter stands from what it names, mm.
const OFF: [f64; 3] = [2.4, 3.6, 5.2];

/// Where a fault shows, and its name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault<'a> {
    /// In which polygon.
    pub diagram: DiagramKind,
    /// Where the student has it, mm from the pole, y up.
    pub at: Mm2,
    /// What it is.
    pub text: &'a str,
}

/// A vector as the student handed it in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HandedIn {
    /// In which polygon.
    pub diagram: DiagramKind,
    /// Its tail, mm from the pole, y up.
    pub from: Mm2,
    /// Its head.
    pub to: Mm2,
    /// The name of its head.
    pub head: Label,
}

/// So many times as far from the pole as the farthest image of the right polygon stands what is still drawn of the
/// student's.
const FARTHEST: f64 = 3.0;
/// It stands at least so far, mm.
const LEAST_REACH: f64 = 20.0;

/// The right polygons; over them dashed, with arrows and starred letters, those of a student where they differ: as far as
/// they are known to be drawn, and vectors as they were handed in. Each fault is circled where the student has it,
/// numbered and named below, with a legend. `None` where there is no polygon.
#[must_use]
pub fn overlay(
    scene: &Scene,
    right: &Construction,
    student: &Construction,
    handed_in: &[HandedIn],
    faults: &[Fault<'_>],
) -> Option<Figure> {
    let words = Language::English.words();
    let notation = Notation::new(scene, words);
    let right = told_apart(right, &notation);
    let mut blocks: Vec<(Group, f64, f64)> = Vec::new();
    for polygon in &right.diagrams {
        let own = student.diagram(polygon.kind);
        let mut panel = polygon::draw(polygon, &right.steps, &notation, None);
        let mut arrows: Vec<(Mm2, Mm2, Label, bool)> =
            own.map_or_else(Vec::new, |own| differing(polygon, own));
        let extent = polygon.images.iter().map(|image| libm::hypot(image.at[0], image.at[1]));
        let extent = extent.fold(LEAST_REACH, f64::max);
        let reach = FARTHEST * extent;
        for vector in handed_in.iter().filter(|vector| vector.diagram == polygon.kind) {
            let near = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) <= SAME;
            if !arrows.iter().any(|(from, to, ..)| near(*from, vector.from) && near(*to, vector.to)) {
                arrows.push((vector.from, vector.to, vector.head, true));
            }
        }
        let here: Vec<(usize, &Fault<'_>)> =
            (1..).zip(faults).filter(|(_, fault)| fault.diagram == polygon.kind).collect();
        // What stands metres away would leave nothing else to be seen.
        arrows.retain(|(from, to, ..)| [from, to].into_iter().all(|at| libm::hypot(at[0], at[1]) <= reach));
        draw_arrows(&mut panel, &arrows, polygon.kind, &notation);
        for (number, fault) in &here {
            let far = libm::hypot(fault.at[0], fault.at[1]);
            let centre = page(if far > reach { fault.at.map(|mm| mm * extent / far) } else { fault.at });
            let circle = Shape::Circle { centre, radius: CIRCLE };
            panel.mark(Mark::stroke(circle, Pen::solid(THIN)).class("fault"));
            if faults.len() > 1 {
                name(&mut panel, &Rich::bold(number.to_string()), centre, CIRCLE, "fault-number");
            }
        }
        let ink = panel.bounds().unwrap_or(Rect::ZERO);
        panel.translate(Vec2::new(-ink.x0, -ink.y0));
        let mut block = Group::new("block");
        block.group(panel);
        let (width, mut y) = (ink.width(), ink.height() + BLANK);
        let mut widest = width;
        for (number, fault) in here {
            let text =
                if faults.len() > 1 { format!("{number}. {}", fault.text) } else { fault.text.to_owned() };
            for line in Rich::upright(text).wrap(SMALL, width.max(NARROWEST)) {
                widest = widest.max(line.width(SMALL));
                line.set(SMALL).put(&mut block, Point::new(0.0, y), "caption");
                y += LINE;
            }
            y += BLANK - LINE;
        }
        blocks.push((block, widest, y));
    }
    let (mut root, y) = arranged(blocks);
    if y > 0.0 {
        legend(&mut root, y, !faults.is_empty());
    }
    let title = scene.title.in_language(words.tag).unwrap_or(words.untitled);
    let texts: Vec<&str> = faults.iter().map(|fault| fault.text).collect();
    (y > 0.0).then(|| localised(cut(root, format!("{title}: overlay"), texts.join("; "), words), scene))
}

/// Blocks side by side or one below the other, whichever fills a page better, and how high they are together.
fn arranged(blocks: Vec<(Group, f64, f64)>) -> (Group, f64) {
    let sum = |of: fn(&(Group, f64, f64)) -> f64| blocks.iter().map(of).sum::<f64>();
    let most = |of: fn(&(Group, f64, f64)) -> f64| blocks.iter().map(of).fold(0.0, f64::max);
    let gaps = BETWEEN * blocks.len().saturating_sub(1) as f64;
    let fits = |width: f64, height: f64| (PAGE.0 / width).min(PAGE.1 / height);
    let beside = fits(sum(|block| block.1) + gaps, most(|block| block.2))
        > fits(most(|block| block.1), sum(|block| block.2));
    let height = if beside { most(|block| block.2) } else { sum(|block| block.2) };
    let mut root = Group::new("overlay");
    let mut at = Vec2::ZERO;
    for (mut block, width, own) in blocks {
        // Those side by side stand on one line.
        let down = if beside { height - own } else { 0.0 };
        block.translate(at + Vec2::new(0.0, down));
        root.group(block);
        at += if beside { Vec2::new(width + BETWEEN, 0.0) } else { Vec2::new(0.0, own) };
    }
    (root, height)
}

/// The student's vectors where they differ: tail, head, name of the head, whether it is one of those that are drawn thick.
fn differing(right: &Diagram, own: &Diagram) -> Vec<(Mm2, Mm2, Label, bool)> {
    let apart = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) > SAME;
    let differs = |vector: &&crate::graphical::construction::Vector| {
        let same = right.vectors.iter().find(|v| v.quantity == vector.quantity && v.kind == vector.kind);
        !same.is_some_and(|v| !apart(v.from, vector.from) && !apart(v.to, vector.to))
    };
    let whole = |kind| matches!(kind, VectorKind::Absolute | VectorKind::Relative);
    own.vectors.iter().filter(differs).map(|v| (v.from, v.to, v.head, whole(v.kind))).collect()
}

fn draw_arrows(
    panel: &mut Group,
    arrows: &[(Mm2, Mm2, Label, bool)],
    kind: DiagramKind,
    notation: &Notation<'_>,
) {
    let mut group = Group::new("student");
    for &(from, to, _, whole) in arrows {
        let pen = Pen { width: if whole { THIN } else { FINE }, dash: Dash::Dashed };
        let (from, to) = (page(from), page(to));
        let way = to - from;
        if way.hypot() <= 0.0 {
            continue;
        }
        group.mark(Mark::stroke(Shape::Line(from, to), pen).class("student"));
        group.mark(head(to, way.normalize(), HEAD.min(way.hypot() / 3.0)));
    }
    panel.group(group);
    let mut named: Vec<(Label, Mm2)> = Vec::new();
    for &(_, to, label, _) in arrows {
        let near = |at: Mm2| libm::hypot(at[0] - to[0], at[1] - to[1]) <= SAME;
        if label == Label::Pole || named.iter().any(|(known, at)| *known == label && near(*at)) {
            continue;
        }
        named.push((label, to));
        let letter = notation.image(label, kind).up("*");
        name(panel, &letter, page(to), 0.0, "label student-name");
    }
}

/// Sets a name beside a place, where it touches no other text if there is such a place, and of these where it lies on the
/// fewest lines.
fn name(panel: &mut Group, text: &Rich, at: Point, radius: f64, class: &'static str) {
    let mut taken: Vec<Rect> = Vec::new();
    let mut lines: Vec<(Point, Point)> = Vec::new();
    panel.walk(&mut |node| match node {
        Node::Text(text) => taken.extend(text.bounds()),
        Node::Mark(Mark { shape: Shape::Line(from, to), .. }) => lines.push((*from, *to)),
        _ => {}
    });
    let line = text.set(SMALL);
    let ink = line.ink_at(Point::ZERO);
    let place = |off: f64, turn: u8| {
        let angle = f64::from(turn) * std::f64::consts::FRAC_PI_4 - 0.6;
        let middle = at + Vec2::new(libm::cos(angle), libm::sin(angle)) * (radius + off);
        middle - ink.center().to_vec2()
    };
    let cost = |from: Point| {
        let own = (ink + from.to_vec2()).inflate(0.3, 0.3);
        let texts = taken.iter().filter(|other| !own.intersect(**other).is_zero_area()).count();
        let crosses =
            |(a, b): &&(Point, Point)| (0..=60).any(|part| own.contains(a.lerp(*b, f64::from(part) / 60.0)));
        100 * texts + lines.iter().filter(crosses).count()
    };
    let places = OFF.into_iter().flat_map(|off| (0..8).map(move |turn| (off, turn)));
    let best = places.map(|(off, turn)| place(off, turn)).min_by_key(|from| cost(*from));
    line.put(panel, best.unwrap_or_else(|| place(OFF[0], 0)), class);
}

/// What the lines mean.
fn legend(root: &mut Group, y: f64, faults: bool) {
    let mut legend = Group::new("legend");
    let mut x = 0.0;
    let mut entry = |legend: &mut Group, text: &str, dash: Dash| {
        let (from, to) = (Point::new(x, y), Point::new(x + 12.0, y));
        legend.mark(Mark::stroke(Shape::Line(from, to), Pen { width: THIN, dash }));
        legend.mark(head(to, Vec2::new(1.0, 0.0), HEAD));
        let words = Rich::upright(text);
        words.set(SMALL).put(legend, Point::new(x + 14.0, y + 1.2), "caption");
        x += 14.0 + words.width(SMALL) + 8.0;
    };
    entry(&mut legend, "right", Dash::Solid);
    entry(&mut legend, "yours, letters with *", Dash::Dashed);
    if faults {
        let centre = Point::new(x + 2.5, y);
        legend.mark(Mark::stroke(Shape::Circle { centre, radius: 2.5 }, Pen::solid(THIN)));
        let words = Rich::upright("where a fault shows");
        words.set(SMALL).put(&mut legend, Point::new(x + 7.0, y + 1.2), "caption");
    }
    root.group(legend);
}
