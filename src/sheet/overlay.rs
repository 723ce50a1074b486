//! A student's polygons over the right ones.

use kurbo::{Point, Rect, Vec2};

use super::compose::{cut, localised};
use super::feet::told_apart;
use super::figure::{Dash, Figure, Group, Mark, Pen, Shape};
use super::ink::{FINE, SMALL, THIN, page};
use super::notation::Notation;
use super::polygon;
use super::rich::Rich;
use super::words::Language;
use crate::graphical::construction::{Construction, Mm2, Polygon, VectorKind};
use crate::mechanism::quantity::Order;
use crate::scene::Scene;

/// A vector of the student that lies nearer to the right one than this (mm) is not drawn twice.
const SAME: f64 = 0.5;
/// Radius of the circle about a fault, mm.
const CIRCLE: f64 = 4.5;
/// Blank between two polygons, and between a polygon and its caption, mm.
const BLANK: f64 = 8.0;

/// Where a fault shows, and its name.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fault<'a> {
    /// In which polygon.
    pub order: Order,
    /// Where in it, mm from the pole, y up.
    pub at: Mm2,
    /// What it is.
    pub text: &'a str,
}

/// The right polygons, over them thin and dashed those of a student where they differ, the first fault circled and
/// named below. `None` where there is no polygon.
#[must_use]
pub fn overlay(
    scene: &Scene,
    right: &Construction,
    student: &Construction,
    fault: Option<Fault<'_>>,
) -> Option<Figure> {
    let words = Language::English.words();
    let notation = Notation::new(scene, words);
    let right = told_apart(right, &notation);
    let mut root = Group::new("overlay");
    let mut y = 0.0;
    let pairs = [(&right.velocity, &student.velocity), (&right.acceleration, &student.acceleration)];
    for (polygon, own) in pairs {
        let Some(polygon) = polygon else { continue };
        let mut panel = polygon::draw(polygon, &right.steps, &notation);
        if let Some(own) = own {
            panel.group(drawn_by_student(polygon, own));
        }
        let here = fault.filter(|fault| fault.order == polygon.order);
        if let Some(fault) = here {
            let circle = Shape::Circle { centre: page(fault.at), radius: CIRCLE };
            panel.mark(Mark::stroke(circle, Pen::solid(THIN)).class("fault"));
        }
        let ink = panel.bounds().unwrap_or(Rect::ZERO);
        panel.translate(Vec2::new(-ink.x0, y - ink.y0));
        root.group(panel);
        y += ink.height() + BLANK;
        if let Some(fault) = here {
            Rich::upright(fault.text).set(SMALL).put(&mut root, Point::new(0.0, y), "caption");
            y += BLANK;
        }
    }
    let title = scene.title.in_language(words.tag).unwrap_or(words.untitled);
    let description = fault.map_or_else(String::new, |fault| fault.text.to_owned());
    (y > 0.0).then(|| localised(cut(root, format!("{title}: overlay"), description, words), scene))
}

/// The student's vectors where they differ.
fn drawn_by_student(right: &Polygon, own: &Polygon) -> Group {
    let mut group = Group::new("student");
    let apart = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) > SAME;
    for vector in &own.vectors {
        let same = right.vectors.iter().find(|v| v.quantity == vector.quantity && v.kind == vector.kind);
        if same.is_some_and(|v| !apart(v.from, vector.from) && !apart(v.to, vector.to)) {
            continue;
        }
        let whole = matches!(vector.kind, VectorKind::Absolute | VectorKind::Relative);
        let pen = Pen { width: if whole { THIN } else { FINE }, dash: Dash::Dashed };
        let (from, to) = (page(vector.from), page(vector.to));
        group.mark(Mark::stroke(Shape::Line(from, to), pen).class("student"));
        let dot = Shape::Circle { centre: to, radius: 0.5 };
        group.mark(Mark::stroke(dot, Pen::solid(FINE)).class("student"));
    }
    group
}
