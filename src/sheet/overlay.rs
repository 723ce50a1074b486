//! A student's polygons, centres and forces over the right ones.

use kurbo::{Point, Rect, Vec2};

use super::compose::{cut, localised};
use super::feet::told_apart;
use super::figure::{Dash, Figure, Group, Mark, Node, Pen, Shape, Tone};
use super::force_names;
use super::ink::{FINE, HEAD, SMALL, THIN, head, page};
use super::notation::Notation;
use super::polygon;
use super::rich::Rich;
use super::skeleton;
use super::words::{Language, Words};
use crate::graphical::construction::{Construction, Diagram, ForceSheet, FreeBody, Label, Mm2, VectorKind};
use crate::mechanism::force::{Action, Party};
use crate::mechanism::quantity::{DiagramKind, Quantity};
use crate::mechanism::{Mechanism, PointId};
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
    /// In which figure.
    pub at: Spot,
    /// What it is.
    pub text: &'a str,
}

/// Where a student has something.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// In a polygon, mm from the pole, or on the skeleton, mm from its origin; y up.
    In(DiagramKind, Mm2),
    /// At the head of a force of [`Own::forces`], by its index.
    Force(usize),
}

/// What a student handed in, where it is not right.
#[derive(Debug, Clone, Default)]
pub struct Own {
    /// Vectors of the polygons.
    pub vectors: Vec<HandedIn>,
    /// Centres and joints on the skeleton, mm: the student's, and the right one.
    pub places: Vec<(Quantity, Mm2, Mm2)>,
    /// Forces of the balance.
    pub forces: Vec<OwnForce>,
}

/// A force on a body as a student has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnForce {
    /// The body, by its index in the balance.
    pub body: usize,
    /// Which force.
    pub action: Action,
    /// As it acts on that body, N.
    pub force: [f64; 2],
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
/// The largest force of a body, mm.
const LARGEST_FORCE: f64 = 60.0;
/// So far beside each other stand a student's forces there and back, mm.
const BESIDE: f64 = 1.6;
/// Where on its arrow a force is named: nearer to its head, so that those there and back are not named at one place.
const NAMED: f64 = 0.64;
/// Two marks of a student with one letter that stand no farther apart (mm) are one.
const TWICE: f64 = 1.5;
/// Radius of the mark of a student's centre, mm.
const DOT: f64 = 1.2;
/// It stands at least so far, mm.
const LEAST_REACH: f64 = 20.0;

/// The right polygons; over them dashed, with arrows and starred letters, those of a student where they differ: as far as
/// they are known to be drawn, and vectors as they were handed in. Before them the skeleton with the places that he has
/// otherwise, behind them the force polygons of the bodies of which he has a force otherwise. Each fault is circled where
/// the student has it, numbered and named below, with a legend. `None` where nothing is drawn.
#[must_use]
pub fn overlay(
    scene: &Scene,
    right: &Construction,
    (student, own): (&Construction, &Own),
    balance: Option<&ForceSheet>,
    (faults, language): (&[Fault<'_>], Language),
) -> Option<Figure> {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let right = told_apart(right, &notation);
    let several = faults.len() > 1;
    let mut blocks: Vec<(Group, f64, f64)> = Vec::new();
    let told = |fits: &dyn Fn(Spot) -> bool| -> Vec<(usize, &Fault<'_>)> {
        (1..).zip(faults).filter(|(_, fault)| fits(fault.at)).collect()
    };
    let on_skeleton = told(&|spot| matches!(spot, Spot::In(DiagramKind::Skeleton, _)));
    if !own.places.is_empty() || !on_skeleton.is_empty() {
        let mut panel = skeleton::draw(&right, &notation);
        let ink = panel.bounds().unwrap_or(Rect::ZERO);
        draw_links(&mut panel, &scene.mechanism, (&right, student, &own.places), ink);
        draw_places(&mut panel, &own.places, ink, &notation);
        for (number, fault) in &on_skeleton {
            if let Spot::In(_, at) = fault.at {
                circle(&mut panel, within(page(at), ink), several.then_some(*number));
            }
        }
        blocks.push(captioned(panel, (&on_skeleton, None), several));
    }
    for polygon in &right.diagrams {
        let drawn = student.diagram(polygon.kind);
        let mut panel = polygon::draw(polygon, &right.steps, &notation, None);
        let mut arrows: Vec<(Mm2, Mm2, Label, bool)> =
            drawn.map_or_else(Vec::new, |drawn| differing(polygon, drawn));
        let extent = polygon.images.iter().map(|image| libm::hypot(image.at[0], image.at[1]));
        let extent = extent.fold(LEAST_REACH, f64::max);
        let reach = FARTHEST * extent;
        for vector in own.vectors.iter().filter(|vector| vector.diagram == polygon.kind) {
            // What is handed in as a value and as a point of the drawing is drawn once.
            let near = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) <= TWICE;
            let known = |(from, to, head, _): &(Mm2, Mm2, Label, bool)| {
                *head == vector.head && near(*from, vector.from) && near(*to, vector.to)
            };
            if !arrows.iter().any(known) {
                arrows.push((vector.from, vector.to, vector.head, true));
            }
        }
        // Where a point that was handed in stands elsewhere than it would follow, he drew something else: what would follow
        // is not his.
        let elsewhere = |point: PointId| {
            own.vectors.iter().any(|vector| {
                let from_pole = libm::hypot(vector.from[0], vector.from[1]) == 0.0;
                let follows =
                    drawn.and_then(|drawn| drawn.images.iter().rev().find(|one| one.label == vector.head));
                vector.diagram == polygon.kind
                    && from_pole
                    && image_of(vector.head) == Some(point)
                    && follows.is_some_and(|one| {
                        libm::hypot(one.at[0] - vector.to[0], one.at[1] - vector.to[1]) > TWICE
                    })
            })
        };
        arrows.retain(|(from, to, head, _)| {
            let handed_in = |vector: &HandedIn| (vector.from, vector.to, vector.head) == (*from, *to, *head);
            own.vectors.iter().any(handed_in) || !image_of(*head).is_some_and(elsewhere)
        });
        let here = told(&|spot| matches!(spot, Spot::In(kind, _) if kind == polygon.kind));
        // What stands metres away would leave nothing else to be seen: it is drawn as far as the border.
        let is_beyond = |at: Mm2| libm::hypot(at[0], at[1]) > reach;
        let beyond = arrows.iter().any(|(from, to, ..)| is_beyond(*from) || is_beyond(*to));
        arrows.retain(|(from, ..)| !is_beyond(*from));
        arrows.iter_mut().for_each(|(from, to, ..)| *to = as_far_as(reach, *from, *to));
        draw_arrows(&mut panel, &arrows, polygon.kind, &notation);
        for (number, fault) in &here {
            let Spot::In(_, at) = fault.at else { continue };
            let far = libm::hypot(at[0], at[1]);
            let centre = page(if far > reach { at.map(|mm| mm * reach / far) } else { at });
            circle(&mut panel, centre, several.then_some(*number));
        }
        let note = beyond.then_some(words.overlay_beyond);
        blocks.push(captioned(panel, (&here, note), several));
    }
    for (index, body) in balance.iter().flat_map(|balance| balance.bodies.iter().enumerate()) {
        let of = |force: usize| own.forces.get(force).is_some_and(|force| force.body == index);
        if (0..own.forces.len()).any(of) {
            let here = told(&|spot| matches!(spot, Spot::Force(force) if of(force)));
            let numbered = |(number, fault): &(usize, &Fault<'_>)| (fault.at, several.then_some(*number));
            let numbered: Vec<(Spot, Option<usize>)> = here.iter().map(numbered).collect();
            let panel = force_polygon(body, (index, &own.forces), &numbered, &notation);
            blocks.push(captioned(entitled(panel, of_body(body, &notation)), (&here, None), several));
        }
    }
    let (mut root, y) = arranged(blocks);
    if y > 0.0 {
        legend(&mut root, y, !faults.is_empty(), words);
    }
    let title = scene.title.in_language(words.tag).unwrap_or(words.untitled);
    // What is read out has no lowered letters.
    let texts: Vec<String> = faults.iter().map(|fault| fault.text.replace('_', "")).collect();
    let title = format!("{title}: {}", words.overlay);
    (y > 0.0).then(|| localised(cut(root, title, texts.join(words.semicolon), words), scene))
}

/// The head of an arrow that begins so near to the pole, on its way to where it would leave the figure.
fn as_far_as(reach: f64, from: Mm2, to: Mm2) -> Mm2 {
    if libm::hypot(to[0], to[1]) <= reach {
        return to;
    }
    let way = [to[0] - from[0], to[1] - from[1]];
    let [square, along, rest] = [
        way[0] * way[0] + way[1] * way[1],
        way[0] * from[0] + way[1] * from[1],
        from[0] * from[0] + from[1] * from[1] - reach * reach,
    ];
    let part = (libm::sqrt(along * along - square * rest) - along) / square;
    [0, 1].map(|axis| from[axis] + part * way[axis])
}

/// A panel with what is said of its faults below it, and of the whole of it, how wide and how high it is.
fn captioned(
    mut panel: Group,
    (faults, note): (&[(usize, &Fault<'_>)], Option<&str>),
    several: bool,
) -> (Group, f64, f64) {
    let ink = panel.bounds().unwrap_or(Rect::ZERO);
    panel.translate(Vec2::new(-ink.x0, -ink.y0));
    let mut block = Group::new("block");
    block.group(panel);
    let (width, mut y) = (ink.width(), ink.height() + BLANK);
    let mut widest = width;
    let faults = faults.iter().map(|(number, fault)| match several {
        true => format!("{number}. {}", fault.text),
        false => fault.text.to_owned(),
    });
    for text in note.map(str::to_owned).into_iter().chain(faults) {
        for line in lowered(&text).wrap(SMALL, width.max(NARROWEST)) {
            widest = widest.max(line.width(SMALL));
            line.set(SMALL).put(&mut block, Point::new(0.0, y), "caption");
            y += LINE;
        }
        y += BLANK - LINE;
    }
    (block, widest, y)
}

/// A text whose symbols are written as plain characters, V_B, with their indices lowered.
fn lowered(text: &str) -> Rich {
    let mut pieces = text.split('_');
    let first = Rich::upright(pieces.next().unwrap_or_default());
    pieces.fold(first, |rich, piece| {
        let end = piece.find(|c: char| !c.is_alphanumeric() && c != '′').unwrap_or(piece.len());
        let (index, after) = piece.split_at(end);
        rich.sub(index).up(after)
    })
}

/// The circle about a fault, with its number where there are several.
fn circle(panel: &mut Group, centre: Point, number: Option<usize>) {
    let circle = Shape::Circle { centre, radius: CIRCLE };
    panel.mark(Mark::stroke(circle, Pen::solid(THIN)).class("fault"));
    if let Some(number) = number {
        name(panel, &Rich::bold(number.to_string()), centre, CIRCLE, "fault-number");
    }
}

/// A place as far from the skeleton as it may stand on the sheet: what lies farther is drawn on its way there.
fn within(at: Point, skeleton: Rect) -> Point {
    let (middle, room) = (skeleton.center(), skeleton.inflate(skeleton.width(), skeleton.height()));
    let way = at - middle;
    let over = (way.x.abs() / (room.width() / 2.0)).max(way.y.abs() / (room.height() / 2.0));
    if over > 1.0 { middle + way * (1.0 / over) } else { at }
}

/// The links of the student's skeleton, dashed, where a joint stands elsewhere: as he handed it in, or as it follows.
fn draw_links(
    panel: &mut Group,
    mechanism: &Mechanism,
    (right, student, places): (&Construction, &Construction, &[(Quantity, Mm2, Mm2)]),
    skeleton: Rect,
) {
    let own = |point: PointId| {
        let given = places.iter().find(|(of, ..)| *of == Quantity::Position(point)).map(|(_, own, _)| *own);
        given.or_else(|| student.space.places.get(point.0).copied().flatten())
    };
    let moved = |point: PointId| {
        let right = right.space.places.get(point.0).copied().flatten();
        let pair = right.zip(own(point));
        pair.is_some_and(|(a, b)| libm::hypot(a[0] - b[0], a[1] - b[1]) > TWICE)
    };
    for link in mechanism.moving() {
        let points = &mechanism.link(link).points;
        let closes = (points.len() > 2).then(|| [points[0], points[points.len() - 1]]);
        for [a, b] in points.windows(2).map(|two| [two[0], two[1]]).chain(closes) {
            if let (true, Some(from), Some(to)) = (moved(a) || moved(b), own(a), own(b)) {
                let [from, to] = [from, to].map(|at| within(page(at), skeleton));
                let dashed = Pen { width: THIN, dash: Dash::Dashed };
                panel.mark(Mark::stroke(Shape::Line(from, to), dashed).class("student"));
            }
        }
    }
}

/// The student's places as open circles; of a centre the right one as a dot, and a dashed line from one to the other.
fn draw_places(panel: &mut Group, places: &[(Quantity, Mm2, Mm2)], skeleton: Rect, notation: &Notation<'_>) {
    for &(quantity, own, right) in places {
        let [own, right] = [own, right].map(|at| within(page(at), skeleton));
        let open = Shape::Circle { centre: own, radius: DOT };
        panel.mark(Mark::stroke(open, Pen::solid(THIN)).class("student"));
        let letter = notation.symbol(quantity, false);
        // A joint stands on the skeleton with its letter already.
        if !matches!(quantity, Quantity::Position(_)) {
            let dashed = Pen { width: FINE, dash: Dash::Dashed };
            panel.mark(Mark::stroke(Shape::Line(right, own), dashed).class("student"));
            panel.mark(Mark::area(Shape::Circle { centre: right, radius: DOT / 2.0 }, Tone::Ink));
            name(panel, &letter, right, DOT, "label");
        }
        name(panel, &letter.up("*"), own, DOT, "label student-name");
    }
}

/// The forces on a body one after the other, as they close, and over them the student's polygon, from the first of his forces
/// that is not right: tip to tail as well, with the right forces where he has no other.
fn force_polygon(
    body: &FreeBody,
    (index, own): (usize, &[OwnForce]),
    faults: &[(Spot, Option<usize>)],
    notation: &Notation<'_>,
) -> Group {
    let mut panel = Group::new("force-polygon");
    let long = |force: [f64; 2]| libm::hypot(force[0], force[1]);
    let largest = body.acting.iter().map(|acting| long(acting.force)).fold(0.0, f64::max);
    let scale = if largest > 0.0 { LARGEST_FORCE / largest } else { 1.0 };
    let mut drawn: Vec<(Point, Point)> = Vec::new();
    // Each beside all arrows, those that come after it too.
    let mut names: Vec<(Rich, Point)> = Vec::new();
    let mut arrow = |panel: &mut Group, from: Point, to: Point, letter: &Rich, dash: Dash, class| {
        let way = to - from;
        if way.hypot() > 0.0 {
            // Of a student's forces there and back each has a stroke of its own.
            let side = Vec2::new(-way.y, way.x).normalize() * BESIDE;
            let stroke = |beside: u8| (from + side * f64::from(beside), to + side * f64::from(beside));
            let free = |beside: &u8| !drawn.iter().any(|other| covers(*other, stroke(*beside)));
            let beside = if dash == Dash::Dashed { (0..3).find(free).unwrap_or(0) } else { 0 };
            let (from, to) = stroke(beside);
            if dash == Dash::Dashed {
                drawn.push((from, to));
            }
            panel.mark(Mark::stroke(Shape::Line(from, to), Pen { width: THIN, dash }).class(class));
            panel.mark(head(to, way.normalize(), HEAD.min(way.hypot() / 3.0)));
            names.push((letter.clone(), from.lerp(to, NAMED)));
        }
    };
    let after = |from: Mm2, force: [f64; 2]| [0, 1].map(|axis| from[axis] + scale * force[axis]);
    let (mut from, mut own_from) = (Mm2::default(), Mm2::default());
    let mut circles: Vec<(Point, Option<usize>)> = Vec::new();
    for acting in &body.acting {
        let to = after(from, acting.force);
        let letter = force_names::acting(notation, acting.action);
        let of = |own: &&OwnForce| (own.body, own.action) == (index, acting.action);
        let handed_in = own.iter().rposition(|own| of(&own));
        let force = handed_in.map_or(acting.force, |place| own[place].force);
        if long(acting.force) > 0.0 {
            arrow(&mut panel, page(from), page(to), &letter, Dash::Solid, "force");
        }
        let apart = libm::hypot(own_from[0] - from[0], own_from[1] - from[1]) > SAME;
        let end = after(own_from, force);
        // What would leave the sheet is drawn as far as it goes, and nothing goes on from there.
        let reach = scale * long(force);
        let short = (FARTHEST * LARGEST_FORCE / reach).min(1.0);
        if (apart || handed_in.is_some()) && reach > 0.0 {
            let tip = after(own_from, force.map(|part| short * part));
            arrow(&mut panel, page(own_from), page(tip), &letter.up("*"), Dash::Dashed, "student");
            let here =
                |(spot, _): &&(Spot, Option<usize>)| handed_in.is_some_and(|at| *spot == Spot::Force(at));
            circles.extend(faults.iter().filter(here).map(|(_, number)| (page(tip), *number)));
        }
        (from, own_from) = (to, if short < 1.0 { to } else { end });
    }
    for (letter, at) in names {
        name(&mut panel, &letter, at, 0.0, "label");
    }
    for (at, number) in circles {
        circle(&mut panel, at, number);
    }
    panel
}

/// Whether a stroke lies on another one.
fn covers((a, b): (Point, Point), (from, to): (Point, Point)) -> bool {
    let along = (b - a).normalize();
    let beside = [from, to].iter().all(|end| (*end - a).cross(along).abs() < BESIDE / 2.0);
    let [start, end] = [from, to].map(|end| (end - a).dot(along));
    beside && start.max(end).min(a.distance(b)) - start.min(end).max(0.0) > BESIDE
}

/// Whose forces a polygon has.
fn of_body(body: &FreeBody, notation: &Notation<'_>) -> Rich {
    let words = notation.words;
    match body.of {
        Party::Link(link) => {
            let link = ("link", Rich::upright(notation.mechanism().link(link).number.to_string()));
            Rich::fill(words.force_polygon_figure, &[link])
        }
        Party::Pin(point) => Rich::fill(words.pin_polygon_figure, &[("point", notation.point(point))]),
    }
}

/// A panel with its title below it.
fn entitled(mut panel: Group, title: Rich) -> Group {
    let ink = panel.bounds().unwrap_or(Rect::ZERO);
    title.set(SMALL).put(&mut panel, Point::new(ink.x0, ink.y1 + LINE + 1.0), "caption");
    panel
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

/// Of which point an image or the end of a component is.
fn image_of(label: Label) -> Option<PointId> {
    match label {
        Label::Image { point, .. } | Label::Foot { point, .. } => Some(point),
        Label::Pole | Label::Trial { .. } => None,
    }
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
        let near = |at: Mm2| libm::hypot(at[0] - to[0], at[1] - to[1]) <= TWICE;
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
        // Joints and centres; the circle about a fault is wider.
        Node::Mark(Mark { shape: Shape::Circle { centre, radius }, .. }) if *radius < CIRCLE => {
            taken.push(Rect::from_center_size(*centre, (2.0 * radius, 2.0 * radius)));
        }
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
fn legend(root: &mut Group, y: f64, faults: bool, own: &Words) {
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
    entry(&mut legend, own.overlay_right, Dash::Solid);
    entry(&mut legend, own.overlay_yours, Dash::Dashed);
    if faults {
        let centre = Point::new(x + 2.5, y);
        legend.mark(Mark::stroke(Shape::Circle { centre, radius: 2.5 }, Pen::solid(THIN)));
        let words = Rich::upright(own.overlay_fault);
        words.set(SMALL).put(&mut legend, Point::new(x + 7.0, y + 1.2), "caption");
    }
    root.group(legend);
}
