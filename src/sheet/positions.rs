//! Other positions of the mechanism on its skeleton: thin and dashed, numbered I, II, … in the order of the list.

use kurbo::{Point, Vec2};

use super::figure::{Group, Mark, Pen, Shape, Tone};
use super::human;
use super::ink::{FINE, SMALL, THIN};
use super::labels::{Request, Site};
use super::notation::Notation;
use super::pose::GuideLine;
use super::rich::Rich;
use super::skeleton::{Artist, BLOCK, PIN};
use crate::graphical::construction::{Axes, Construction, OtherKind, OtherPosition};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{Input, LinkId, PointId, Rider};

/// Radius of a pin in another position.
const OTHER_PIN: f64 = 0.7;
/// What lies closer than this to its present place is not drawn again.
const SAME: f64 = 0.05;

/// The ink of all other positions, and their numbers.
pub(super) fn draw(construction: &Construction, notation: &Notation<'_>) -> (Group, Vec<Request>) {
    let mut all = Group::new("other-positions");
    let mut labels = Vec::new();
    for (index, other) in construction.others.iter().enumerate() {
        let moved = moved(construction, other);
        let (before, after) = (Artist::new(construction, notation), Artist::new(&moved, notation));
        let mut own = Group::new("other-position").data("number", number(index, other));
        if let OtherKind::Input(at) = other.kind {
            own = own.data("input", format!("{at}"));
        }
        bars(&before, &after, &mut own);
        blocks(&before, &after, &mut own);
        for (point, at) in moved_points(&before, &after) {
            let circle = Shape::Circle { centre: at, radius: OTHER_PIN };
            let mut joint = Group::new("other-joint").data("point", notation.point_name(point));
            joint.mark(Mark::outlined(circle, Pen::solid(FINE), Tone::Paper).precise());
            own.group(joint);
        }
        all.group(own);
        labels.extend(names(&before, &after, index, other, notation));
    }
    (all, labels)
}

/// What the dashed lines are, for the caption: one line of text for the positions, one for the assembly.
pub(super) fn legend(construction: &Construction, notation: &Notation<'_>) -> Vec<Rich> {
    let words = notation.words;
    let list: Vec<Rich> = construction
        .others
        .iter()
        .enumerate()
        .filter_map(|(index, other)| match other.kind {
            OtherKind::Input(at) => Some(numeral(index).up(":\u{a0}").then(&place(at, notation)?)),
            OtherKind::Assembly => None,
        })
        .collect();
    let mut lines = Vec::new();
    if !list.is_empty() {
        let list = Rich::join(&list, &Rich::upright(words.comma));
        lines.push(Rich::fill(words.other_positions, &[("list", list)]));
    }
    if construction.others.iter().any(|other| other.kind == OtherKind::Assembly) {
        lines.push(Rich::upright(words.other_assembly));
    }
    lines
}

/// The positions that are wished, in words, for the question.
pub(super) fn asked(notation: &Notation<'_>) -> Vec<Rich> {
    let (words, sheet) = (notation.words, &notation.scene.sheet);
    let list: Vec<Rich> = sheet.positions.iter().filter_map(|at| place(*at, notation)).collect();
    let mut all = Vec::new();
    if !list.is_empty() {
        let list = Rich::join(&list, &Rich::upright(words.comma));
        all.push(Rich::fill(words.asked_positions, &[("list", list)]));
    }
    if sheet.other_assembly {
        all.push(Rich::upright(words.asked_assembly));
    }
    all
}

/// θ₂ = 60°, or the place of a driven slide.
fn place(at: f64, notation: &Notation<'_>) -> Option<Rich> {
    let equals = "\u{a0}=\u{a0}";
    match notation.mechanism().inputs.first()? {
        Input::Angle { link, .. } | Input::Speed { link, .. } => {
            Some(notation.symbol(Quantity::Angle(*link), false).up(equals).then(&human::degrees(at)))
        }
        Input::Slide { .. } => {
            Some(Rich::italic("s").up(equals).then(&human::stated_quantity(at, &notation.scene.units.length)))
        }
    }
}

/// The construction with the mechanism in its other position.
fn moved(construction: &Construction, other: &OtherPosition) -> Construction {
    let mut moved = construction.clone();
    let per_mm = construction.space.metres_per_mm;
    let on_paper = |at: [f64; 2]| at.map(|x| x / per_mm);
    moved.space.places = other.places.iter().map(|at| at.map(on_paper)).collect();
    let axes = |axes: Axes| Axes { origin: on_paper(axes.origin), ..axes };
    moved.space.axes = other.axes.iter().map(|own| own.map(axes)).collect();
    moved
}

fn number(index: usize, other: &OtherPosition) -> String {
    match other.kind {
        OtherKind::Input(_) => roman(index + 1),
        OtherKind::Assembly => "assembly".to_owned(),
    }
}

fn numeral(index: usize) -> Rich {
    Rich::upright(roman(index + 1))
}

/// A small number in Roman numerals: Arabic ones number the links.
fn roman(mut number: usize) -> String {
    let mut out = String::new();
    for (value, sign) in [(10, "X"), (9, "IX"), (5, "V"), (4, "IV"), (1, "I")] {
        while number >= value {
            out.push_str(sign);
            number -= value;
        }
    }
    out
}

/// The links as dashed lines; the middle line of a slot and a bar along it are one line.
fn bars(before: &Artist<'_>, after: &Artist<'_>, own: &mut Group) {
    let same = |a: (Point, Point), b: (Point, Point)| a.0.distance(b.0) < SAME && a.1.distance(b.1) < SAME;
    let mut lines: Vec<(LinkId, Shape)> = Vec::new();
    let mut covered = Vec::new();
    for slot in &after.slots {
        if before.slots.iter().any(|then| then.index == slot.index && same(then.ends, slot.ends)) {
            continue;
        }
        let mut line = slot.middle_line();
        if let Shape::Line(from, to) = &mut line {
            let along = (*to - *from).normalize();
            let bars = after.bars.iter().enumerate().filter(|(_, (l, ..))| *l == slot.link);
            for (i, &(_, a, b)) in bars {
                if [a, b].iter().all(|p| (*p - *from).cross(along).abs() < THIN) {
                    covered.push(i);
                    for p in [a, b] {
                        *from = if (p - *from).dot(along) < 0.0 { p } else { *from };
                        *to = if (p - *to).dot(along) > 0.0 { p } else { *to };
                    }
                }
            }
        }
        lines.push((slot.link, line));
    }
    for (i, &(link, a, b)) in after.bars.iter().enumerate() {
        let rests = before.bars.iter().any(|(l, c, d)| *l == link && same((*c, *d), (a, b)));
        if !rests && !covered.contains(&i) {
            lines.push((link, Shape::Line(a, b)));
        }
    }
    for (link, line) in lines {
        let mut bar = Group::new("other-link").data("link", after.notation.number(link));
        bar.mark(Mark::stroke(line, Pen::dashed(THIN)).precise());
        own.group(bar);
    }
}

/// Sliders as dashed rectangles on their guides.
fn blocks(before: &Artist<'_>, after: &Artist<'_>, own: &mut Group) {
    for slide in &after.notation.mechanism().slides {
        let Some(line) = after.pose.guide(slide) else { continue };
        let (at, along) = match line {
            GuideLine::Straight { at, along } => (at, along),
            GuideLine::Arc { at, centre } => {
                let radius = (at - centre).normalize();
                (at, Vec2::new(-radius.y, radius.x))
            }
        };
        let rests = before.pose.rider(slide).is_some_and(|then| then.distance(at) < SAME);
        if rests || slide.guide.link != LinkId::FRAME {
            continue;
        }
        let (length, width) = (along * BLOCK.0, Vec2::new(-along.y, along.x) * BLOCK.1);
        let corners =
            vec![at + length + width, at - length + width, at - length - width, at + length - width];
        own.mark(Mark::stroke(Shape::Polygon(corners), Pen::dashed(FINE)).class("slider"));
    }
}

/// The pins and riders that do not stand where they stand now.
fn moved_points(before: &Artist<'_>, after: &Artist<'_>) -> Vec<(PointId, Point)> {
    let mechanism = after.notation.mechanism();
    let is_joint = |p: PointId| {
        let rides = |r: &Rider| matches!(r, Rider::Pin { point, .. } if *point == p);
        mechanism.pins.iter().any(|pin| pin.point == p) || mechanism.slides.iter().any(|s| rides(&s.rider))
    };
    let points = (0..mechanism.points.len()).map(PointId).filter(|p| is_joint(*p));
    points
        .filter_map(|p| {
            let at = after.pose.place(p)?;
            before.pose.place(p).is_none_or(|then| then.distance(at) >= SAME).then_some((p, at))
        })
        .collect()
}

/// The number of a position at the pin that is driven and, where there is room, at the others; the pins of the other
/// assembly with their own names in parentheses.
fn names(
    before: &Artist<'_>,
    after: &Artist<'_>,
    index: usize,
    other: &OtherPosition,
    notation: &Notation<'_>,
) -> Vec<Request> {
    let driven = match notation.mechanism().inputs.first() {
        Some(Input::Angle { link, .. } | Input::Speed { link, .. }) => {
            notation.mechanism().link(*link).points.clone()
        }
        Some(Input::Slide { slide, .. }) => match notation.mechanism().slides[*slide].rider {
            Rider::Pin { point, .. } => vec![point],
            Rider::Link { link, .. } => notation.mechanism().link(link).points.clone(),
        },
        None => Vec::new(),
    };
    let moved = moved_points(before, after);
    if moved.is_empty() && other.kind != OtherKind::Assembly {
        // It is the position of the scene itself.
        let pin = driven.iter().rev().find_map(|p| before.pose.place(*p));
        let site = pin.map(|at| Site::Around { at, radius: PIN + 0.2, toward: before.outward(at) });
        let own = site.map(|site| Request::new(numeral(index), SMALL, site, "label other-name"));
        return own.map(|own| Request { leader: true, ..own }).into_iter().collect();
    }
    let first = moved.iter().find(|(p, _)| driven.contains(p)).or(moved.first()).map(|(p, _)| *p);
    let named = |&(point, at): &(PointId, Point)| {
        let text = match other.kind {
            OtherKind::Input(_) => numeral(index),
            OtherKind::Assembly => Rich::upright("(").then(&notation.point(point)).up(")"),
        };
        let site = Site::Around { at, radius: OTHER_PIN + 0.2, toward: after.outward(at) };
        let mut request = Request::new(text, SMALL, site, "label other-name");
        request.leader = true;
        request.optional = Some(point) != first;
        request
    };
    moved.iter().map(named).collect()
}
