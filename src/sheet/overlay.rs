//! A student's polygons, centres and forces over the right ones.

use kurbo::{Point, Rect, Vec2};

use super::compose::{cut, localised};
use super::feet::{printed, told_apart};
use super::figure::{Dash, Figure, Group, Mark, Node, Pen, Shape, Tone};
use super::force_names;
use super::ink::{FINE, HEAD, SMALL, THIN, head, page};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::polygon;
use super::rich::Rich;
use super::skeleton::{self, Arrows};
use super::words::{Language, Words};
use crate::graphical::construction::{
    Acting, Construction, Diagram, ForceSheet, FreeBody, Label, Mm2, VectorKind,
};
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
/// Room of a sheet for them, mm.
const SHEET: (f64, f64) = (180.0, 150.0);
/// Width of a printed page between its margins, mm.
const PAGE: f64 = 180.0;
/// Room of one drawing on a printed page, mm: the first in which all fit what is left of the page.
const ROOMS: [(f64, f64); 3] = [(PAGE, 150.0), (PAGE, 100.0), (PAGE, 72.0)];
/// Where all do not fit it, the report goes on overleaf, as long as the first strip does.
const OVERLEAF: f64 = 250.0;
/// How often a drawing is made smaller that does not fit its room: names do not shrink with it.
const TRIES: usize = 5;
/// From one line of a caption to the next, mm.
const LINE: f64 = 4.6;
/// Captions are not set narrower than this, mm.
const NARROWEST: f64 = 80.0;

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
    /// Points of the polygons.
    pub points: Vec<OwnPoint>,
    /// Polygons whose points were handed in: nothing else in them is known to be the student's.
    pub drawn: Vec<DiagramKind>,
    /// Centres and joints on the skeleton, mm: the student's, and the right one.
    pub places: Vec<(Quantity, Mm2, Mm2)>,
    /// Forces of the balance.
    pub forces: Vec<OwnForce>,
    /// Those that are right.
    pub right_forces: Vec<OwnForce>,
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
    /// Whether it is one of those that are drawn thick.
    pub whole: bool,
}

/// A point of a polygon as the student handed it in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OwnPoint {
    /// In which polygon.
    pub diagram: DiagramKind,
    /// What it is.
    pub label: Label,
    /// As the student letters it.
    pub letter: Label,
    /// Where it stands, mm from the pole, y up.
    pub at: Mm2,
    /// Whether it is not right: what is right is named by the sheet.
    pub amiss: bool,
}

/// So many times as far from the pole as the farthest image of the right polygon stands what is still drawn of the
/// student's.
const FARTHEST: f64 = 2.5;
/// So many times as far stands the border to which the rest is drawn.
const BORDER: f64 = 1.5;
/// The largest force of a body, mm.
const LARGEST_FORCE: f64 = 60.0;
/// So far beside each other stand a student's forces there and back, mm.
const BESIDE: f64 = 1.6;
/// Two marks of a student with one letter that stand no farther apart (mm) are one.
const TWICE: f64 = 1.5;
/// Radius of the mark of a student's centre, mm.
const DOT: f64 = 1.2;
/// It stands at least so far, mm.
const LEAST_REACH: f64 = 20.0;
/// A right polygon is drawn at least so far from its pole, mm: beside one that is many times too large it would be a speck.
const TO_BE_SEEN: f64 = 45.0;
/// And no farther than this.
const ON_A_SHEET: f64 = 200.0;

/// The right polygons; over them dashed, with arrows and starred letters, those of a student where they differ: as far as
/// they are known to be drawn, and vectors as they were handed in. Before them the skeleton with the places that he has
/// otherwise, behind them the force polygons of the bodies of which he has a force otherwise. Each fault is circled where
/// the student has it, numbered and named below, with a legend. Names of both are placed together, clear of the ink of both.
/// To be printed, with so much `left` of the page (mm), it stands in strips no wider than a page, drawn as small as that takes, with
/// names as large as ever.
/// `None` where nothing is drawn.
#[must_use]
pub fn overlay(
    scene: &Scene,
    right: &Construction,
    (student, own): (&Construction, &Own),
    balance: Option<&ForceSheet>,
    (faults, language): (&[Fault<'_>], Language),
    left: Option<f64>,
) -> Option<Figure> {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let mut own = own.clone();
    for vector in &mut own.vectors {
        vector.head = foot_told_apart(vector, (right, student), &notation);
    }
    for point in &mut own.points {
        [point.label, point.letter] =
            [point.label, point.letter].map(|label| printed(right, &notation, (point.diagram, label)));
    }
    let [right, student] = [right, student].map(|one| told_apart(one, &notation));
    let drawings = Drawings { right: &right, student: &student, own: &own, faults, notation };
    let blocks = |room: Option<(f64, f64)>| drawings.blocks(scene, balance, room);
    let (mut root, y) = match left {
        Some(left) => on_page(left, |room| strips_of(blocks(Some(room)))),
        None => arranged(blocks(None)),
    };
    if y > 0.0 {
        let mut follows = false;
        root.walk(&mut |node| follows |= is_dotted(node));
        let legend = legend(y, (follows, !faults.is_empty()), words);
        match root.children.last_mut() {
            // With the last strip.
            Some(Node::Group(last)) if left.is_some() => last.group(legend),
            _ => root.group(legend),
        }
    }
    let title = scene.title.in_language(words.tag).unwrap_or(words.untitled);
    // What is read out has no lowered letters.
    let texts: Vec<String> = faults.iter().map(|fault| fault.text.replace('_', "")).collect();
    let title = format!("{title}: {}", words.overlay);
    (y > 0.0).then(|| localised(cut(root, title, texts.join(words.semicolon), words), scene))
}

/// The strips of a printed overlay from the top: each is a piece of the figure that is not to be cut.
#[must_use]
pub fn strips(figure: &Figure) -> Vec<Rect> {
    let strip = |node: &Node| match node {
        Node::Group(group) if group.class == STRIP => group.bounds(),
        _ => None,
    };
    figure.root.children.iter().filter_map(strip).collect()
}

/// Strips in the largest room in which all fit what is left of a page, or at least the first, and the others the next page.
fn on_page(left: f64, strips: impl Fn((f64, f64)) -> (Group, f64)) -> (Group, f64) {
    let first = |group: &Group| match group.children.first() {
        Some(Node::Group(strip)) => strip.bounds().map_or(0.0, |ink| ink.height()),
        _ => 0.0,
    };
    let mut kept: Option<(Group, f64)> = None;
    for room in ROOMS {
        let (group, height) = strips(room);
        let top = first(&group);
        // With what tells of the lines.
        if height + 2.0 * LINE <= left {
            return (group, height);
        }
        let goes_on = top < height && top <= left && height - top + 2.0 * LINE <= OVERLEAF;
        if kept.is_none() && (goes_on || height <= OVERLEAF) {
            kept = Some((group, height));
        }
    }
    kept.unwrap_or_else(|| strips(ROOMS[ROOMS.len() - 1]))
}

/// The class of a strip.
const STRIP: &str = "strip";

/// What a student drew, beside what is right.
struct Drawings<'d> {
    right: &'d Construction,
    student: &'d Construction,
    own: &'d Own,
    faults: &'d [Fault<'d>],
    notation: Notation<'d>,
}

/// A panel with its captions, how wide and how high it is.
type Block = (Group, f64, f64);

impl Drawings<'_> {
    /// The faults that show at certain places, with their numbers.
    fn told(&self, fits: impl Fn(Spot) -> bool) -> Vec<(usize, &Fault<'_>)> {
        (1..).zip(self.faults).filter(|(_, fault)| fits(fault.at)).collect()
    }

    /// The number of a fault, where there are several.
    fn numbered(&self, number: usize) -> Option<usize> {
        (self.faults.len() > 1).then_some(number)
    }

    /// Every panel, no larger than its room.
    fn blocks(&self, scene: &Scene, balance: Option<&ForceSheet>, room: Option<(f64, f64)>) -> Vec<Block> {
        let several = self.faults.len() > 1;
        let mut blocks = Vec::new();
        let on_skeleton = self.told(|spot| matches!(spot, Spot::In(DiagramKind::Skeleton, _)));
        if !self.own.places.is_empty() || !on_skeleton.is_empty() {
            let draw = |times: f64| self.skeleton(&scene.mechanism, &on_skeleton, times);
            blocks.push(captioned(fitted(room, draw), (&on_skeleton, None), several));
        }
        for polygon in &self.right.diagrams {
            let here = self.told(|spot| matches!(spot, Spot::In(kind, _) if kind == polygon.kind));
            // Drawn at the student's scale what is right may be a speck, or larger than the sheet.
            let extent = extent(polygon);
            let larger = if extent > 0.0 { extent.clamp(TO_BE_SEEN, ON_A_SHEET) / extent } else { 1.0 };
            let over = self.over((polygon, larger), &here);
            let panel = fitted(room, |times| self.polygon((polygon.kind, larger), &over, times));
            let note = over.beyond.then_some(self.notation.words.overlay_beyond);
            blocks.push(captioned(panel, (&here, note), several));
        }
        for (index, body) in balance.iter().flat_map(|balance| balance.bodies.iter().enumerate()) {
            let of = |force: usize| self.own.forces.get(force).is_some_and(|force| force.body == index);
            if (0..self.own.forces.len()).any(of) {
                let here = self.told(|spot| matches!(spot, Spot::Force(force) if of(force)));
                let spots: Vec<(Spot, Option<usize>)> =
                    here.iter().map(|(number, fault)| (fault.at, self.numbered(*number))).collect();
                let draw = |times: f64| {
                    let own = (index, self.own);
                    let panel = force_polygon(body, own, &spots, &self.notation, times);
                    entitled(panel, of_body(body, &self.notation))
                };
                blocks.push(captioned(fitted(room, draw), (&here, None), several));
            }
        }
        blocks
    }

    /// The skeleton, so many times as large, with the student's places.
    fn skeleton(&self, mechanism: &Mechanism, faults: &[(usize, &Fault<'_>)], times: f64) -> Group {
        let [mut right, mut student] = [self.right, self.student].map(Clone::clone);
        right.resize(times);
        student.resize(times);
        let scaled = |at: Mm2| at.map(|mm| times * mm);
        let places: Vec<(Quantity, Mm2, Mm2)> =
            self.own.places.iter().map(|(of, own, right)| (*of, scaled(*own), scaled(*right))).collect();
        skeleton::draw_under(&right, &self.notation, Arrows::All, None, |ink, _| {
            let mut over = skeleton::Overlay::default();
            let circles: Vec<(Point, Option<usize>)> = faults
                .iter()
                .filter_map(|(number, fault)| match fault.at {
                    Spot::In(_, at) => Some((within(page(scaled(at)), ink), self.numbered(*number))),
                    Spot::Force(_) => None,
                })
                .collect();
            draw_links(&mut over.ink, mechanism, (&right, &student, &places), ink);
            draw_places(&mut over, &places, (ink, &circles), &self.notation);
            circle_all(&mut over, &circles);
            over
        })
    }

    /// What of the student's is drawn over a polygon that is drawn so many times larger.
    fn over(&self, (polygon, larger): (&Diagram, f64), faults: &[(usize, &Fault<'_>)]) -> Over {
        let scaled = |at: Mm2| at.map(|mm| larger * mm);
        let enlarged = |diagram: &Diagram| {
            let mut diagram = diagram.clone();
            diagram.images.iter_mut().for_each(|image| image.at = scaled(image.at));
            let ends = diagram.vectors.iter_mut().flat_map(|vector| [&mut vector.from, &mut vector.to]);
            ends.for_each(|end| *end = scaled(*end));
            diagram
        };
        let is_drawn = self.own.drawn.contains(&polygon.kind);
        let drawn = self.student.diagram(polygon.kind).filter(|_| !is_drawn).map(enlarged);
        let polygon = &enlarged(polygon);
        let own: Vec<HandedIn> =
            self.own.vectors.iter().copied().filter(|own| own.diagram == polygon.kind).collect();
        let own: Vec<HandedIn> = own
            .into_iter()
            .map(|own| HandedIn { from: scaled(own.from), to: scaled(own.to), ..own })
            .collect();
        let points = self.own.points.iter().filter(|point| point.diagram == polygon.kind);
        let mut points: Vec<OwnPoint> =
            points.map(|point| OwnPoint { at: scaled(point.at), ..*point }).collect();
        let mut arrows: Vec<Arrow> = drawn.as_ref().map_or_else(Vec::new, |drawn| differing(polygon, drawn));
        let extent = extent(polygon).max(LEAST_REACH);
        let reach = FARTHEST * extent;
        let near = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) <= TWICE;
        // Where he has something elsewhere than it would follow, he drew something else: what would follow is not his.
        let elsewhere = |label: Label| {
            own.iter().any(|vector| {
                let follows = drawn.as_ref().and_then(|drawn| at_last(drawn, vector.head));
                let of_one_point = matches!(vector.head, Label::Image { .. })
                    && image_of(vector.head).is_some()
                    && image_of(vector.head) == image_of(label);
                (of_one_point || vector.head == label) && follows.is_some_and(|at| !near(at, vector.to))
            })
        };
        arrows.retain(|arrow| !elsewhere(arrow.head) && !elsewhere(arrow.tail));
        for vector in &own {
            // What is handed in as a value and as a point of the drawing is drawn once.
            let known = |arrow: &Arrow| {
                arrow.head == vector.head && near(arrow.from, vector.from) && near(arrow.to, vector.to)
            };
            let same = arrows.iter_mut().find(|arrow| known(arrow));
            if let Some(same) = same {
                same.own = true;
            } else {
                let HandedIn { from, to, head, whole, .. } = *vector;
                arrows.push(Arrow { from, to, tail: Label::Pole, head, whole, own: true, named: true });
            }
        }
        // What stands metres away would leave nothing else to be seen: it is drawn as far as the border, which then lies about
        // what is right and what of his lies within reach.
        let far = |at: Mm2| libm::hypot(at[0], at[1]);
        let beyond = arrows.iter().any(|arrow| far(arrow.from).max(far(arrow.to)) > reach);
        let within = arrows.iter().flat_map(|arrow| [far(arrow.from), far(arrow.to)]);
        let within = within.filter(|far| *far <= reach).fold(BORDER * extent, f64::max);
        let reach = if beyond { within } else { reach };
        arrows.retain(|arrow| far(arrow.from) <= reach);
        // One from the pole first: what it leads to is named at the border, where it is circled, and at no other line to it.
        arrows.sort_by_key(|arrow| far(arrow.from) > 0.0);
        let mut gone: Vec<(Label, Mm2, Mm2)> = Vec::new();
        for arrow in &mut arrows {
            let end = arrow.to;
            arrow.to = as_far_as(reach, arrow.from, end);
            if arrow.to != end {
                arrow.named = !gone.iter().any(|(label, at, _)| *label == arrow.head && near(*at, end));
                gone.push((arrow.head, end, arrow.to));
            }
        }
        let onto_border = |at: Mm2| {
            let ended = gone.iter().find(|(_, end, _)| near(*end, at)).map(|(.., border)| *border);
            let on_its_way = || if far(at) > reach { at.map(|mm| mm * reach / far(at)) } else { at };
            ended.unwrap_or_else(on_its_way)
        };
        // A point beyond the border has its name at the end of what leads to it.
        points.retain(|point| far(point.at) <= reach);
        let circles = faults.iter().filter_map(|(number, fault)| {
            let Spot::In(_, at) = fault.at else { return None };
            let at = scaled(at);
            // A vector that ends where it should shows its fault where it begins.
            let ends_rightly = |vector: &&HandedIn| {
                let image = polygon.images.iter().find(|image| image.label == vector.head);
                vector.to == at && image.is_some_and(|image| near(image.at, at)) && vector.from != [0.0; 2]
            };
            let at = own.iter().find(ends_rightly).map_or(at, |vector| vector.from);
            Some((onto_border(at), self.numbered(*number)))
        });
        Over { circles: circles.collect(), arrows, points, beyond }
    }

    /// A polygon, so many times larger, and so many times as large as its room allows, with what is laid over it.
    fn polygon(&self, (kind, larger): (DiagramKind, f64), over: &Over, times: f64) -> Group {
        let mut right = self.right.clone();
        right.resize(larger * times);
        let Some(polygon) = right.diagram(kind) else { return Group::default() };
        let scaled = |at: Mm2| at.map(|mm| times * mm);
        let arrows: Vec<Arrow> = over
            .arrows
            .iter()
            .map(|arrow| Arrow { from: scaled(arrow.from), to: scaled(arrow.to), ..*arrow })
            .collect();
        let points: Vec<OwnPoint> =
            over.points.iter().map(|point| OwnPoint { at: scaled(point.at), ..*point }).collect();
        let circles: Vec<(Point, Option<usize>)> =
            over.circles.iter().map(|(at, number)| (page(scaled(*at)), *number)).collect();
        let mut over = skeleton::Overlay::default();
        draw_arrows(&mut over, (&arrows, &points), (polygon, &circles), &self.notation);
        circle_all(&mut over, &circles);
        polygon::draw_under(polygon, &right.steps, &self.notation, None, &over)
    }
}

/// A vector of the student.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Arrow {
    from: Mm2,
    to: Mm2,
    tail: Label,
    head: Label,
    /// Whether it is one of those that are drawn thick.
    whole: bool,
    /// Whether it was handed in, and does not only follow.
    own: bool,
    /// Whether its head is named.
    named: bool,
}

/// Where faults are circled, with their numbers.
type Circles = Vec<(Mm2, Option<usize>)>;

/// What is laid over a polygon.
struct Over {
    arrows: Vec<Arrow>,
    points: Vec<OwnPoint>,
    circles: Circles,
    /// Whether something of it leaves the figure.
    beyond: bool,
}

/// How far from the pole the farthest image stands, mm.
fn extent(polygon: &Diagram) -> f64 {
    polygon.images.iter().map(|image| libm::hypot(image.at[0], image.at[1])).fold(0.0, f64::max)
}

/// Where a point of a polygon stands: of several of one name the last that was drawn.
fn at_last(polygon: &Diagram, label: Label) -> Option<Mm2> {
    polygon.images.iter().rev().find(|image| image.label == label).map(|image| image.at)
}

/// The name of a vector's head as it is where feet that would share one are told apart.
fn foot_told_apart(
    vector: &HandedIn,
    (right, student): (&Construction, &Construction),
    notation: &Notation<'_>,
) -> Label {
    if !matches!(vector.head, Label::Foot { .. }) {
        return vector.head;
    }
    let own = student.diagram(vector.diagram);
    let index = own.and_then(|drawn| {
        drawn.vectors.iter().position(|one| one.head == vector.head && one.from == vector.from)
    });
    let told = index.and_then(|index| {
        told_apart(student, notation)
            .diagram(vector.diagram)
            .and_then(|drawn| Some(drawn.vectors.get(index)?.head))
    });
    told.unwrap_or_else(|| printed(right, notation, (vector.diagram, vector.head)))
}

/// A panel as large as it is, or so much smaller that it fits its room: its names are no smaller for that.
fn fitted(room: Option<(f64, f64)>, draw: impl Fn(f64) -> Group) -> Group {
    /// A little more smaller than it seems to take, for names do not shrink.
    const MORE: f64 = 0.97;
    let mut panel = draw(1.0);
    let Some((width, height)) = room else { return panel };
    let mut times = 1.0;
    for _ in 0..TRIES {
        let ink = panel.bounds().unwrap_or(Rect::ZERO);
        let over = (ink.width() / width).max(ink.height() / height);
        if over <= 1.0 {
            break;
        }
        times *= MORE / over;
        panel = draw(times);
    }
    panel
}

/// Blocks in rows no wider than a page, each row a strip, and how high they are together.
fn strips_of(blocks: Vec<Block>) -> (Group, f64) {
    let mut rows: Vec<Vec<Block>> = Vec::new();
    let width = |row: &[Block]| row.iter().map(|block| block.1 + BETWEEN).sum::<f64>();
    for block in blocks {
        match rows.last_mut() {
            Some(row) if width(row) + block.1 <= PAGE => row.push(block),
            _ => rows.push(vec![block]),
        }
    }
    let mut root = Group::new("overlay");
    let mut y = 0.0;
    for row in rows {
        let height = row.iter().map(|block| block.2).fold(0.0, f64::max);
        let mut strip = Group::new(STRIP);
        let mut x = 0.0;
        for (mut block, width, own) in row {
            // Those side by side stand on one line.
            block.translate(Vec2::new(x, y + height - own));
            strip.group(block);
            x += width + BETWEEN;
        }
        root.group(strip);
        y += height;
    }
    (root, y)
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
    // What begins at the border itself may begin behind it by its rounding.
    let part = ((libm::sqrt((along * along - square * rest).max(0.0)) - along) / square).clamp(0.0, 1.0);
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
        // Of a′_4,1 both numbers.
        let end = |(at, c): (usize, char)| {
            let goes_on = || piece[at + c.len_utf8()..].starts_with(|next: char| next.is_ascii_digit());
            !(c.is_alphanumeric() || c == '′' || c == ',' && goes_on())
        };
        let end = piece.char_indices().find(|one| end(*one)).map_or(piece.len(), |(at, _)| at);
        let (index, after) = piece.split_at(end);
        rich.sub(index).up(after)
    })
}

/// The circles about faults, with their numbers where there are several.
fn circle_all(over: &mut skeleton::Overlay, circles: &[(Point, Option<usize>)]) {
    for &(centre, number) in circles {
        let circle = Shape::Circle { centre, radius: CIRCLE };
        over.ink.mark(Mark::stroke(circle, Pen::solid(THIN)).class("fault"));
        if let Some(number) = number {
            let toward = Some(std::f64::consts::FRAC_PI_4);
            let site = Site::Around { at: centre, radius: CIRCLE, toward };
            let number = Rich::bold(number.to_string());
            over.labels.push(Request::new(number, SMALL, site, "fault-number"));
        }
    }
}

/// The name of a point of the student's: beside it, outside of the circle about it where there is one.
fn starred(text: Rich, at: Point, radius: f64, circles: &[(Point, Option<usize>)]) -> Request {
    let site = |radius: f64| Site::Around { at, radius, toward: None };
    let mut request = Request::new(text, SMALL, site(radius), "label student-name");
    if circles.iter().any(|(centre, _)| centre.distance(at) < TWICE) {
        request.sites = vec![site(CIRCLE)];
    }
    request.leader = true;
    request.strict = true;
    request
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
fn draw_places(
    over: &mut skeleton::Overlay,
    places: &[(Quantity, Mm2, Mm2)],
    (skeleton, circles): (Rect, &[(Point, Option<usize>)]),
    notation: &Notation<'_>,
) {
    for &(quantity, own, right) in places {
        let [own, right] = [own, right].map(|at| within(page(at), skeleton));
        let open = Shape::Circle { centre: own, radius: DOT };
        over.ink.mark(Mark::stroke(open, Pen::solid(THIN)).class("student"));
        let letter = notation.symbol(quantity, false);
        // A joint stands on the skeleton with its letter already.
        if !matches!(quantity, Quantity::Position(_)) {
            let dashed = Pen { width: FINE, dash: Dash::Dashed };
            over.ink.mark(Mark::stroke(Shape::Line(right, own), dashed).class("student"));
            over.ink.mark(Mark::area(Shape::Circle { centre: right, radius: DOT / 2.0 }, Tone::Ink));
            over.labels.push(Request { class: "label", ..starred(letter.clone(), right, DOT, circles) });
        }
        over.labels.push(starred(letter.up("*"), own, DOT, circles));
    }
}

/// Whether a force is found by the polygon, not laid off in it.
fn is_found(action: Action) -> bool {
    !matches!(
        action,
        Action::Inertia(_)
            | Action::Centrifugal(_)
            | Action::Load(_)
            | Action::Weight(_)
            | Action::Spring { .. }
            | Action::Drag(_)
    )
}

/// The forces on a body as a student has them, N: as he handed them in, else what is laid off. One that is found and was not
/// handed in closes his polygon where it is the only one; of several nobody knows his.
fn theirs(body: &FreeBody, (index, own): (usize, &Own)) -> Vec<Option<[f64; 2]>> {
    let of = |action: Action| {
        let mut all = own.forces.iter().rev().chain(&own.right_forces);
        all.find(|own| (own.body, own.action) == (index, action)).map(|own| own.force)
    };
    let known = |acting: &Acting| of(acting.action).or((!is_found(acting.action)).then_some(acting.force));
    let mut forces: Vec<Option<[f64; 2]>> = body.acting.iter().map(known).collect();
    let open: Vec<usize> = (0..forces.len()).filter(|&place| forces[place].is_none()).collect();
    if let &[one] = &open[..] {
        let rest = [0, 1].map(|axis| -forces.iter().flatten().map(|force| force[axis]).sum::<f64>());
        forces[one] = Some(rest);
    }
    forces
}

/// The forces on a body one after the other, as they close, and over them the student's polygon, from the first of his forces
/// that is not right: tip to tail as well, without those of which he tells nothing.
fn force_polygon(
    body: &FreeBody,
    (index, own): (usize, &Own),
    faults: &[(Spot, Option<usize>)],
    notation: &Notation<'_>,
    times: f64,
) -> Group {
    let largest_drawn = times * LARGEST_FORCE;
    let mut panel = Group::new("force-polygon");
    let long = |force: [f64; 2]| libm::hypot(force[0], force[1]);
    let largest = body.acting.iter().map(|acting| long(acting.force)).fold(0.0, f64::max);
    let scale = if largest > 0.0 { largest_drawn / largest } else { 1.0 };
    let mut drawn: Vec<(Point, Point)> = Vec::new();
    // Each beside all arrows, those that come after it too.
    let mut names: Vec<Request> = Vec::new();
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
            let mut name = Request::new(letter.clone(), SMALL, Site::Along { from, to }, "label");
            name.leader = true;
            name.strict = true;
            names.push(name);
        }
    };
    let after = |from: Mm2, force: [f64; 2]| [0, 1].map(|axis| from[axis] + scale * force[axis]);
    let (mut from, mut own_from) = (Mm2::default(), Mm2::default());
    let mut circles: Vec<(Point, Option<usize>)> = Vec::new();
    for (acting, theirs) in body.acting.iter().zip(theirs(body, (index, own))) {
        let to = after(from, acting.force);
        let letter = force_names::acting(notation, acting.action);
        let of = |own: &&OwnForce| (own.body, own.action) == (index, acting.action);
        let handed_in = own.forces.iter().rposition(|own| of(&own));
        if long(acting.force) > 0.0 {
            arrow(&mut panel, page(from), page(to), &letter, Dash::Solid, "force");
        }
        let between = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]);
        let Some(force) = theirs else {
            own_from = if between(own_from, from) > SAME { own_from } else { to };
            from = to;
            continue;
        };
        let end = after(own_from, force);
        let apart = between(own_from, from) > SAME || between(end, to) > SAME;
        // What would leave the sheet is drawn as far as it goes, and nothing goes on from there.
        let reach = scale * long(force);
        let short = (FARTHEST * largest_drawn / reach).min(1.0);
        if (apart || handed_in.is_some()) && reach > 0.0 {
            let tip = after(own_from, force.map(|part| short * part));
            arrow(&mut panel, page(own_from), page(tip), &letter.up("*"), Dash::Dashed, "student");
            let here =
                |(spot, _): &&(Spot, Option<usize>)| handed_in.is_some_and(|at| *spot == Spot::Force(at));
            circles.extend(faults.iter().filter(here).map(|(_, number)| (page(tip), *number)));
        }
        (from, own_from) = (to, if short < 1.0 { to } else { end });
    }
    let mut over = skeleton::Overlay { ink: Group::new("faults"), labels: names, within: None };
    circle_all(&mut over, &circles);
    panel.group(over.ink);
    let names = place(&panel, &over.labels, None);
    panel.group(names);
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
fn arranged(blocks: Vec<Block>) -> (Group, f64) {
    let sum = |of: fn(&Block) -> f64| blocks.iter().map(of).sum::<f64>();
    let most = |of: fn(&Block) -> f64| blocks.iter().map(of).fold(0.0, f64::max);
    let gaps = BETWEEN * blocks.len().saturating_sub(1) as f64;
    let fits = |width: f64, height: f64| (SHEET.0 / width).min(SHEET.1 / height);
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

/// The student's vectors where they differ.
fn differing(right: &Diagram, own: &Diagram) -> Vec<Arrow> {
    let apart = |a: Mm2, b: Mm2| libm::hypot(a[0] - b[0], a[1] - b[1]) > SAME;
    let differs = |vector: &&crate::graphical::construction::Vector| {
        let same = right.vectors.iter().find(|v| v.quantity == vector.quantity && v.kind == vector.kind);
        !same.is_some_and(|v| !apart(v.from, vector.from) && !apart(v.to, vector.to))
    };
    let whole = |kind| matches!(kind, VectorKind::Absolute | VectorKind::Relative);
    let arrow = |v: &crate::graphical::construction::Vector| Arrow {
        from: v.from,
        to: v.to,
        tail: v.tail,
        head: v.head,
        whole: whole(v.kind),
        own: false,
        named: true,
    };
    own.vectors.iter().filter(differs).map(arrow).collect()
}

fn draw_arrows(
    over: &mut skeleton::Overlay,
    (arrows, points): (&[Arrow], &[OwnPoint]),
    (right, circles): (&Diagram, &[(Point, Option<usize>)]),
    notation: &Notation<'_>,
) {
    let near = |a: Mm2, b: Mm2, by: f64| libm::hypot(a[0] - b[0], a[1] - b[1]) <= by;
    let mut group = Group::new("student");
    for &Arrow { from, to, whole, own, .. } in arrows {
        let dash = if own { Dash::Dashed } else { Dash::Dotted };
        let pen = Pen { width: if whole { THIN } else { FINE }, dash };
        let (from, to) = (page(from), page(to));
        let way = to - from;
        if way.hypot() <= 0.0 {
            continue;
        }
        group.mark(Mark::stroke(Shape::Line(from, to), pen).class("student"));
        group.mark(head(to, way.normalize(), HEAD.min(way.hypot() / 3.0)));
    }
    // A point to which nothing of his leads is a dot.
    let amiss = || points.iter().filter(|point| point.amiss);
    for point in amiss() {
        let touches = |arrow: &Arrow| near(arrow.from, point.at, SAME) || near(arrow.to, point.at, SAME);
        if !arrows.iter().any(touches) {
            let dot = Shape::Circle { centre: page(point.at), radius: DOT / 2.0 };
            group.mark(Mark::stroke(dot, Pen::solid(THIN)).class("student"));
        }
    }
    over.ink.group(group);
    // The names at each place, once: of his points as he letters them, then of what follows; what stands where it should is
    // named there already.
    let mut named: Vec<(Mm2, Vec<Label>)> = Vec::new();
    let letters = amiss().map(|point| (point.at, point.label, point.letter));
    let heads = arrows.iter().filter(|arrow| arrow.named).map(|arrow| (arrow.to, arrow.head, arrow.head));
    for (at, label, letter) in letters.chain(heads) {
        let stands = right.images.iter().any(|image| image.label == label && near(image.at, at, TWICE));
        let lettered = |point: &OwnPoint| point.label == label && near(point.at, at, TWICE);
        let letter = points.iter().find(|point| lettered(point)).map_or(letter, |point| point.letter);
        let known = named.iter().any(|(there, all)| all.contains(&letter) && near(*there, at, TWICE));
        if label == Label::Pole || stands || known {
            continue;
        }
        match named.iter_mut().find(|(there, _)| near(*there, at, SAME)) {
            Some((_, all)) => all.push(letter),
            None => named.push((at, vec![letter])),
        }
    }
    for (at, labels) in named {
        let letters: Vec<Rich> =
            labels.iter().map(|label| notation.image(*label, right.kind).up("*")).collect();
        let letters = Rich::join(&letters, &Rich::upright(notation.words.comma.trim_end()));
        over.labels.push(starred(letters, page(at), 0.4, circles));
    }
}

/// Whether something is a dotted line.
fn is_dotted(node: &Node) -> bool {
    matches!(node, Node::Mark(Mark { pen: Some(Pen { dash: Dash::Dotted, .. }), .. }))
}

/// What the lines mean.
fn legend(y: f64, (follows, faults): (bool, bool), own: &Words) -> Group {
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
    if follows {
        entry(&mut legend, own.overlay_follows, Dash::Dotted);
    }
    if faults {
        let centre = Point::new(x + 2.5, y);
        legend.mark(Mark::stroke(Shape::Circle { centre, radius: 2.5 }, Pen::solid(THIN)));
        let words = Rich::upright(own.overlay_fault);
        words.set(SMALL).put(&mut legend, Point::new(x + 7.0, y + 1.2), "caption");
    }
    legend
}
