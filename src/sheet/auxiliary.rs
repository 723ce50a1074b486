//! Constructions on the skeleton as ink and in words: Klein's, the inflection circle, two masses; and the lever.

use std::cell::RefCell;

use kurbo::{Point, Rect, Vec2};

use super::compose;
use super::figure::{Group, Mark, Pen, Shape, Tone};
use super::font::Face;
use super::human;
use super::ink::{FINE, HEAD, LABEL, SMALL, THICK, THIN, arrow, head, page, right_angle};
use super::labels::{self, Request, Site};
use super::notation::Notation;
use super::overlap::clip;
use super::printed::{Apart, Figures, Key};
use super::reach::{Reach, Window};
use super::rich::Rich;
use super::skeleton::{self, Arrows, Overlay, PIN};
use super::steps::{self, Item};
use crate::graphical::auxiliary::{
    AuxiliaryAct, AuxiliaryDrawing, InflectionBy, PointName, Proportion, Stroke, StrokeRole, StrokeShape,
    rod_foot,
};
use crate::graphical::construction::{Construction, Label};
use crate::mechanism::force::{Action, Force, Heaviness, Inertia, Mass, Share};
use crate::mechanism::quantity::{DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::{Input, LinkId, PointId};
use crate::plan::Auxiliary;

/// What names about such a figure, its caption and the words below it need of the paper at least, width and height, mm, and how
/// high it is at most, in parts of the paper; what lies further out is off the sheet.
const AROUND: (f64, f64) = (8.0, 40.0);
const MOST_HIGH: f64 = 0.65;
/// Blank kept between a named point and the border.
const BORDER: f64 = 9.0;
/// Places closer than this on paper have one label.
const COINCIDENT: f64 = 0.3;
/// How far a line runs past the point that ends its use.
const PAST: f64 = 4.0;
/// Side of a right-angle mark.
const SQUARE: f64 = 2.2;
/// A pen for what was sought: between links and components.
pub(super) const RESULT: f64 = 0.35;
/// Pieces of a clipped circle.
const PIECES: usize = 360;
const TIMES: &str = "\u{a0}×\u{a0}";
const DOT: &str = "\u{a0}·\u{a0}";
const OVER: &str = "\u{a0}/\u{a0}";
const EQUALS: &str = "\u{a0}= ";

/// The title of the figure.
#[must_use]
pub fn title(kind: &Auxiliary, notation: &Notation<'_>) -> Rich {
    let words = notation.words;
    let link = |link: LinkId| [("link", Rich::upright(notation.number(link)))];
    match *kind {
        Auxiliary::Klein { crank, .. } => Rich::fill(words.klein_figure, &link(crank.rod)),
        Auxiliary::Inflection { link: own } => Rich::fill(words.inflection_figure, &link(own)),
        Auxiliary::Kennedy { links } => {
            Rich::fill(words.kennedy_figure, &[("links", notation.links(&links))])
        }
        Auxiliary::Rotation { link: own, .. } => Rich::fill(words.rotation_figure, &link(own)),
        Auxiliary::Centrodes { links } => {
            let centre = super::circle::name(crate::plan::chord(links[0], links[1]), notation);
            Rich::fill(words.centrodes_figure, &[("centre", centre)])
        }
        Auxiliary::TwoMasses { link: own, .. } => Rich::fill(words.two_masses_figure, &link(own)),
        Auxiliary::Lever { .. } => Rich::upright(words.lever_figure),
    }
}

/// The skeleton with the construction over it; the lever stands by itself.
#[must_use]
pub fn draw(drawing: &AuxiliaryDrawing, reach: &Reach<'_>, notation: &Notation<'_>) -> Group {
    let construction = &*reach.construction;
    let metres_per_mm = construction.space.metres_per_mm;
    if drawing.is_lever() {
        return lever(drawing, metres_per_mm, notation);
    }
    // The arcs by which the skeleton was drawn belong to its own figure.
    let mut bare = construction.clone();
    bare.space.lines.clear();
    bare.others.clear();
    let mut group = skeleton::draw_under(&bare, notation, Arrows::Inputs, None, |_, places| {
        let plate = Plate { drawing, notation: *notation, places, window: reach.window, metres_per_mm };
        let within = Some(reach.paper(notation));
        Overlay { ink: plate.strokes(), labels: plate.labels(), within }
    });
    group.class = "construction-on-skeleton".to_owned();
    group
}

/// The turned velocity polygon with the forces on it.
fn lever(drawing: &AuxiliaryDrawing, metres_per_mm: f64, notation: &Notation<'_>) -> Group {
    let lines = drawing.strokes.iter().filter_map(|stroke| match stroke.shape {
        StrokeShape::Line(from, to) => Some([page(from), page(to)]),
        _ => None,
    });
    let places = lines.flatten().chain(drawing.points.iter().map(|point| page(point.at)));
    let window = places.fold(Rect::ZERO, |window, at| window.union_pt(at)).inflate(BORDER, BORDER);
    let plate = Plate { drawing, notation: *notation, places: &[], window, metres_per_mm };
    let mut group = plate.strokes();
    let labels = labels::place(&group, &plate.labels(), None);
    group.group(labels);
    group
}

/// The skeleton's ink with as many named points as find room, the nearest first, which are needed; then whole circles and closed
/// curves, and the feet to which lines are drawn.
pub(super) fn window(drawing: &AuxiliaryDrawing, skeleton: Rect, notation: &Notation<'_>) -> Window {
    let (width, height) = compose::free_paper(notation.scene);
    let most = (width - AROUND.0, (height - AROUND.1).min(MOST_HIGH * height));
    let mut window = skeleton.inflate(BORDER, BORDER);
    let mut grow = |with: Rect| {
        let grown = window.union(with);
        let fits =
            grown.width() <= most.0.max(window.width()) && grown.height() <= most.1.max(window.height());
        if fits {
            window = grown;
        }
        usize::from(!fits)
    };
    let middle = skeleton.center();
    let mut places: Vec<Point> = drawing.points.iter().map(|p| page(p.at)).collect();
    places.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    let about = |at: Point| Rect::from_center_size(at, (2.0 * BORDER, 2.0 * BORDER));
    let lost: usize = places.into_iter().map(|at| grow(about(at))).sum();
    // Whole circles where there is room for them.
    for stroke in &drawing.strokes {
        if let StrokeShape::Circle { centre, radius } = stroke.shape {
            let size = 2.0 * (radius + 2.0);
            grow(Rect::from_center_size(page(centre), (size, size)));
        }
        if let StrokeShape::Curve { points, ends: [None, None] } = &stroke.shape
            && let Some(first) = points.first()
        {
            let start = Rect::from_center_size(page(*first), (0.0, 0.0));
            grow(points.iter().fold(start, |box_, p| box_.union_pt(page(*p))).inflate(2.0, 2.0));
        }
    }
    // And the feet to which lines are drawn; a line of reference ends where the others do.
    for stroke in drawing.strokes.iter().filter(|stroke| stroke.role != StrokeRole::Axis) {
        if let StrokeShape::Line(from, to) = stroke.shape {
            grow(Rect::from_points(page(from), page(to)).inflate(2.0, 2.0));
        }
    }
    Window { shows: window, lost }
}

struct Plate<'a> {
    drawing: &'a AuxiliaryDrawing,
    notation: Notation<'a>,
    /// Places of the mechanism's points on the page.
    places: &'a [Option<Point>],
    window: Rect,
    /// Of the skeleton under it.
    metres_per_mm: f64,
}

impl Plate<'_> {
    fn strokes(&self) -> Group {
        let mut all = Group::new("auxiliary");
        for stroke in &self.drawing.strokes {
            let mut own = Group::new(match stroke.role {
                StrokeRole::Construction | StrokeRole::Produced => "construction",
                StrokeRole::Image => "image",
                StrokeRole::Axis => "axis",
                StrokeRole::Result => "result",
                StrokeRole::Other => "other-position",
                StrokeRole::Counterpart => "counterpart",
                StrokeRole::Vector => "vector",
            });
            if let Some(claim) = stroke.claim {
                let (name, value) = self.notation.claim_data(claim);
                own = own.data(name, value);
            }
            self.stroke(&mut own, stroke);
            if !own.children.is_empty() {
                all.group(own);
            }
        }
        // What was sought over what led to it, and dots over lines.
        for point in &self.drawing.points {
            let at = page(point.at);
            // A pin has its own symbol, and a curve or a velocity is named, not marked.
            let marked = !is_place(point.name);
            let on_pin = self.places.iter().flatten().any(|p| p.distance(at) < COINCIDENT);
            if self.window.contains(at) && !on_pin && !marked {
                let circle = Shape::Circle { centre: at, radius: 0.7 };
                all.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Ink).class("point").precise());
            }
        }
        all
    }

    fn stroke(&self, own: &mut Group, stroke: &Stroke) {
        let pen = match stroke.role {
            StrokeRole::Construction | StrokeRole::Produced => Pen::solid(FINE),
            StrokeRole::Image => Pen::solid(RESULT),
            StrokeRole::Axis => Pen::chain(FINE),
            StrokeRole::Result => Pen::solid(RESULT),
            StrokeRole::Other => Pen::dashed(THIN),
            StrokeRole::Counterpart => Pen::dashed(RESULT),
            StrokeRole::Vector => Pen::solid(THICK),
        };
        match &stroke.shape {
            StrokeShape::Line(from, to) if stroke.role == StrokeRole::Vector => {
                arrow(own, page(*from), page(*to), THICK);
            }
            StrokeShape::Curve { points, ends } => self.curve(own, points, *ends, pen),
            StrokeShape::Line(from, to) => {
                let (from, to) = (page(*from), page(*to));
                let d = to - from;
                if d.hypot() < COINCIDENT {
                    return;
                }
                let past = match stroke.role {
                    StrokeRole::Produced | StrokeRole::Axis => d.normalize() * PAST,
                    _ => d * 0.0,
                };
                let is_axis = stroke.role == StrokeRole::Axis;
                let back = if is_axis { past } else { past * 0.0 };
                // A line of reference leads to nothing.
                self.line(own, from - back, to + past, if is_axis { from } else { to }, pen);
            }
            StrokeShape::Circle { centre, radius } => self.circle(own, page(*centre), *radius, pen),
            StrokeShape::RightAngle { corner, one, other } => {
                let corner = page(*corner);
                let (one, other) = (page(*one) - corner, page(*other) - corner);
                let room = one.hypot().min(other.hypot());
                if room > SQUARE && self.window.contains(corner) {
                    right_angle(own, corner, one, other, SQUARE.min(room * 0.4));
                }
            }
        }
    }

    /// A line as far as the border; where its end lies beyond, an arrowhead points there.
    fn line(&self, own: &mut Group, from: Point, to: Point, end: Point, pen: Pen) {
        let Some((t0, t1)) = clip(from, to, self.window) else { return };
        let (a, b) = (from.lerp(to, t0), from.lerp(to, t1));
        own.mark(Mark::stroke(Shape::Line(a, b), pen).precise());
        if !self.window.contains(end) && a.distance(b) > 2.0 * HEAD {
            own.mark(head(b, (b - a).normalize(), HEAD));
        }
    }

    /// A curve, cut at the border; where it goes on to infinity, an arrowhead along its asymptote.
    fn curve(&self, own: &mut Group, points: &[[f64; 2]], ends: [Option<[f64; 2]>; 2], pen: Pen) {
        let points: Vec<Point> = points.iter().map(|p| page(*p)).collect();
        let mut pieces: Vec<Vec<Point>> = Vec::new();
        for pair in points.windows(2) {
            let Some((t0, t1)) = clip(pair[0], pair[1], self.window) else { continue };
            // What is not cut is kept to its last bit, so that the pieces join.
            let a = if t0 > 0.0 { pair[0].lerp(pair[1], t0) } else { pair[0] };
            let b = if t1 < 1.0 { pair[0].lerp(pair[1], t1) } else { pair[1] };
            match pieces.last_mut() {
                Some(piece) if piece.last() == Some(&a) => piece.push(b),
                _ => pieces.push(vec![a, b]),
            }
        }
        let runs_out = |end: Option<&Point>| end.is_some_and(|p| !self.window.contains(*p));
        let outside = [runs_out(points.first()), runs_out(points.last())];
        let tips =
            [pieces.first().and_then(|p| p.first().copied()), pieces.last().and_then(|p| p.last().copied())];
        for piece in pieces {
            own.mark(Mark::stroke(Shape::Polyline(piece), pen));
        }
        for ((end, outside), tip) in ends.into_iter().zip(outside).zip(tips) {
            if let (Some([x, y]), true, Some(tip)) = (end, outside, tip) {
                own.mark(head(tip, Vec2::new(x, -y), HEAD));
            }
        }
    }

    /// A circle, cut at the border.
    fn circle(&self, own: &mut Group, centre: Point, radius: f64, pen: Pen) {
        if radius < COINCIDENT {
            return;
        }
        let whole = Rect::from_center_size(centre, (2.0 * radius, 2.0 * radius));
        if self.window.contains_rect(whole) {
            own.mark(Mark::stroke(Shape::Circle { centre, radius }, pen).precise());
            return;
        }
        let at = |i: usize| {
            super::figure::on_circle(
                centre,
                radius,
                std::f64::consts::TAU * (i % PIECES) as f64 / PIECES as f64,
            )
        };
        let inside: Vec<bool> = (0..PIECES).map(|i| self.window.contains(at(i))).collect();
        // Start outside, so that no run is cut at its beginning.
        let Some(start) = inside.iter().position(|own| !own) else { return };
        let mut run: Option<usize> = None;
        for i in start..=start + PIECES {
            match (run, inside[i % PIECES]) {
                (None, true) => run = Some(i),
                (Some(first), false) => {
                    let step = std::f64::consts::TAU / PIECES as f64;
                    let (from, sweep) = (step * first as f64, step * (i - 1 - first) as f64);
                    if sweep > 0.0 {
                        own.mark(
                            Mark::stroke(Shape::Arc { centre, radius, start: from, sweep }, pen).precise(),
                        );
                    }
                    run = None;
                }
                _ => {}
            }
        }
    }

    fn labels(&self) -> Vec<Request> {
        let mut groups: Vec<(Point, f64, Vec<Rich>)> = Vec::new();
        for point in &self.drawing.points {
            let at = page(point.at);
            if !self.window.contains(at) {
                continue;
            }
            let size = if matches!(point.name, PointName::CentrodeIn(_)) { SMALL } else { LABEL };
            let name = name(point.name, &self.notation);
            match groups.iter_mut().find(|(p, ..)| p.distance(at) < COINCIDENT) {
                Some((.., names)) if names.contains(&name) => {}
                Some((.., names)) => names.push(name),
                None => groups.push((at, size, vec![name])),
            }
        }
        groups
            .into_iter()
            .map(|(at, size, names)| {
                let text = Rich::join(&names, &Rich::upright(", "));
                let on_pin = self.places.iter().flatten().any(|p| p.distance(at) < COINCIDENT);
                let radius = if on_pin { PIN + 0.3 } else { 0.9 };
                let site = Site::Around { at, radius, toward: None };
                let mut request = Request::new(text, size, site, "label auxiliary-name");
                request.leader = true;
                request
            })
            .chain(self.vector_names())
            .chain(self.names_beyond())
            .collect()
    }

    /// What lies beyond the border is named where its lines end, with how far it is from the named point at which they begin.
    fn names_beyond(&self) -> Vec<Request> {
        let beyond: Vec<(Point, PointName)> =
            self.drawing.points.iter().map(|own| (page(own.at), own.name)).collect();
        let places = self.places.iter().flatten().copied();
        let known: Vec<Point> = beyond.iter().map(|(at, _)| *at).chain(places).collect();
        let here = |one: Point, other: Point| one.distance(other) < COINCIDENT;
        let mut requests: Vec<Request> = Vec::new();
        for stroke in &self.drawing.strokes {
            let StrokeShape::Line(from, to) = stroke.shape else { continue };
            for (from, to) in [(page(from), page(to)), (page(to), page(from))] {
                let named = beyond.iter().find(|(at, name)| is_place(*name) && here(*at, to));
                let Some((_, of)) = named.filter(|_| !self.window.contains(to)) else { continue };
                let Some((_, t1)) = clip(from, to, self.window) else { continue };
                let border = from.lerp(to, t1);
                let mut text = name(*of, &self.notation);
                if self.window.contains(from) && known.iter().any(|at| here(*at, from)) {
                    let metres = from.distance(to) * self.metres_per_mm;
                    text =
                        text.up("\u{a0}").then(&human::quantity(metres, &self.notation.scene.units.length));
                }
                let site = Site::Around { at: border, radius: 0.6, toward: None };
                let mut request = Request::new(text, SMALL, site, "label auxiliary-name");
                request.leader = true;
                if !requests.contains(&request) {
                    requests.push(request);
                }
            }
        }
        requests
    }

    /// What is read between two image points has its name beside its line, as in a polygon.
    fn vector_names(&self) -> Vec<Request> {
        /// Shorter ones have no room for it; the steps name them.
        const SHORTEST: f64 = 3.0;
        let read = vectors_between(self.drawing).filter(|(_, from, to)| {
            let on_paper = [from, to].iter().all(|at| self.window.contains(**at));
            on_paper && from.distance(*to) >= SHORTEST
        });
        let named = |(text, from, to): (Rich, Point, Point)| {
            let mut request = Request::new(text, SMALL, Site::Along { from, to }, "label vector-name");
            request.leader = true;
            request
        };
        let read = read.map(|(quantity, from, to)| (self.notation.symbol(quantity, false), from, to));
        read.chain(self.accelerations_of_masses()).map(named).collect()
    }

    /// The accelerations of the small polygon of two masses: their names and where they stand on the page.
    fn accelerations_of_masses(&self) -> Vec<(Rich, Point, Point)> {
        /// Shorter ones are known by their image points.
        const SHORTEST: f64 = 5.0;
        let order = Order::Acceleration;
        let points = &self.drawing.points;
        let pole = points.iter().find(|own| own.name == PointName::Image(Label::Pole, order));
        let (Auxiliary::TwoMasses { .. }, Some(pole)) = (&self.drawing.kind, pole) else { return Vec::new() };
        let pole = page(pole.at);
        let symbol = |name: PointName| match name {
            PointName::Image(Label::Image { point, .. }, _) => {
                Some(self.notation.symbol(Quantity::Acceleration(point), false))
            }
            PointName::ImageOfSecond => {
                let index = if self.notation.mechanism().point_named(SECOND).is_some() { "*" } else { "" };
                Some(Rich::italic(self.notation.profile.acceleration).sub(&format!("{SECOND}{index}")))
            }
            _ => None,
        };
        let arrows = points.iter().filter_map(|own| Some((symbol(own.name)?, pole, page(own.at))));
        arrows.filter(|(_, from, to)| from.distance(*to) >= SHORTEST).collect()
    }
}

/// What is laid off or read between two image points, and these on the page.
pub(super) fn vectors_between(
    drawing: &AuxiliaryDrawing,
) -> impl Iterator<Item = (Quantity, Point, Point)> + '_ {
    let place = |label: Label, order: Order| {
        let own = drawing.points.iter().find(|point| point.name == PointName::Image(label, order));
        own.map(|point| page(point.at))
    };
    drawing.acts.iter().filter_map(move |act| match *act {
        AuxiliaryAct::ReadImage { quantity, tail, head, .. } => {
            let order = quantity.order();
            Some((quantity, place(tail, order)?, place(head, order)?))
        }
        AuxiliaryAct::NormalOnRod { crank, .. } => {
            let [a, b] = [crank.crank_pin, crank.slider_pin];
            let from = place(Label::Image { point: a, link: None }, Order::Acceleration)?;
            Some((Quantity::RelativeNormal(b, a), from, place(rod_foot(crank), Order::Acceleration)?))
        }
        AuxiliaryAct::TangentialOnCrank { crank, .. } => {
            let a = Label::Image { point: crank.crank_pin, link: None };
            let [from, to] = [place(a, Order::Velocity)?, place(a, Order::Acceleration)?];
            Some((Quantity::Tangential(crank.crank_pin), from, to))
        }
        _ => None,
    })
}

/// The scales of images on the skeleton that follow from its own, SI units for a millimetre.
pub(super) fn scales(drawing: &AuxiliaryDrawing) -> Vec<(Dimension, f64)> {
    let of = |act: &AuxiliaryAct| match *act {
        AuxiliaryAct::CrankAsImage { velocity, acceleration, .. } => Some((velocity, acceleration)),
        _ => None,
    };
    let Some((velocity, acceleration)) = drawing.acts.iter().find_map(of) else { return Vec::new() };
    let acceleration = acceleration.map(|scale| (Dimension::Acceleration, scale));
    std::iter::once((Dimension::Velocity, velocity)).chain(acceleration).collect()
}

/// A scale that follows from another: 15.7 cm/s ≡ 1 cm.
pub(super) fn scale_that_follows(si_per_mm: f64, dimension: Dimension, notation: &Notation<'_>) -> Rich {
    let unit = notation.unit(dimension);
    let (number, _) = human::factor(si_per_mm * 10.0 / unit.si);
    human::with_unit(&number, &unit.symbol).up("\u{a0}≡\u{a0}1\u{a0}cm")
}

/// Whether a name is that of a place, not of a curve, an arrow or a length.
fn is_place(name: PointName) -> bool {
    !matches!(
        name,
        PointName::CentrodeIn(_)
            | PointName::TrialVelocity(_)
            | PointName::InertiaOfMass(_)
            | PointName::InertiaForce(_)
            | PointName::OffsetOfInertia(_)
            | PointName::LeverForce(_)
            | PointName::LeverEffort(_)
            | PointName::LeverArm(_)
    )
}

/// b′, (13), A with the index w, W, G.
#[must_use]
pub fn name(name: PointName, notation: &Notation<'_>) -> Rich {
    match name {
        PointName::Image(label, order) => notation.image(label, order.diagram()),
        PointName::Centre(links) => super::circle::name(links, notation),
        PointName::Inflection(point) => notation.point_with(point, "w"),
        PointName::InflectionPole => letter("W", notation),
        PointName::AccelerationCentre => letter("G", notation),
        PointName::Moved(point) => notation.point_primed(point),
        PointName::RotationCentre => letter("R", notation),
        PointName::Trial => letter("Q", notation),
        PointName::TrialVelocity(link) => Rich::italic("V").sub(&format!("Q{}", notation.number(link))),
        PointName::CentrodeIn(link) => {
            Rich::fill(notation.words.centrode_in, &[("link", Rich::upright(notation.number(link)))])
        }
        PointName::SecondMass => letter(SECOND, notation),
        PointName::ImageOfSecond => {
            let capital = notation.profile.capital_images;
            let own = if capital { SECOND.to_owned() } else { SECOND.to_lowercase() };
            Rich::italic(own).scripts(notation.profile.prime, Face::Italic, "")
        }
        PointName::MeetOfMasses => letter("O", notation),
        PointName::InertiaOfMass(point) => {
            let taken = notation.mechanism().point_named(SECOND).is_some();
            let second = || if taken { format!("{SECOND}*") } else { SECOND.to_owned() };
            Rich::italic("F").sub(&point.map_or_else(second, |point| notation.index(point)))
        }
        PointName::InertiaForce(link) => force_symbol(Force::Vector(Action::Inertia(link)), notation),
        PointName::OffsetOfInertia(link) => force_symbol(Force::Offset(link), notation),
        PointName::LeverForce(action) => force_symbol(Force::Vector(action), notation),
        PointName::LeverEffort(input) => force_symbol(Force::Drive(input), notation),
        PointName::LeverArm(number) => Rich::italic("y").sub(&number.to_string()),
    }
}

/// Where the second of two masses stands.
const SECOND: &str = "C";

fn force_symbol(force: Force, notation: &Notation<'_>) -> Rich {
    notation.symbol(Quantity::Force(force, Share::Total), false)
}

/// A letter of the construction; with a star where the scene has a point of that name.
fn letter(own: &str, notation: &Notation<'_>) -> Rich {
    let taken = notation.mechanism().point_named(own).is_some();
    let letter = Rich::italic(own);
    if taken { letter.sup("*") } else { letter }
}

/// The steps in words of the construction with this number on the sheet.
#[must_use]
pub fn items(
    index: usize,
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Vec<Item> {
    // What is measured on a figure is told at the scale at which it is drawn.
    let Some(reach) = Reach::of_auxiliary(index, construction, notation) else { return Vec::new() };
    let construction = &*reach.construction;
    let Some(drawing) = construction.auxiliary.get(index) else { return Vec::new() };
    // A construction has readings of its own: what it says of a quantity is not what a polygon said, but for what drives.
    let own = RefCell::new(figures.borrow().of_inputs(Apart::Auxiliary(index), notation));
    let teller = Teller { drawing, construction, window: reach.window, notation, figures: &own };
    let mut all = vec![Item::Head(title(&drawing.kind, notation).bolder())];
    all.extend(drawing.acts.iter().flat_map(|act| teller.sentences(act)).map(Item::Sentence));
    figures.borrow_mut().keep_apart(Apart::Auxiliary(index), &own.borrow(), notation);
    all
}

struct Teller<'a> {
    drawing: &'a AuxiliaryDrawing,
    construction: &'a Construction,
    /// What the figure shows of the plane.
    window: Rect,
    notation: &'a Notation<'a>,
    /// How each number is printed.
    figures: &'a RefCell<Figures>,
}

impl Teller<'_> {
    /// Whether a point lies in the plane, but not on the paper of the figure.
    fn lies_beyond(&self, name: PointName) -> bool {
        let own = self.drawing.points.iter().find(|point| point.name == name);
        own.is_some_and(|own| !self.window.contains(page(own.at)))
    }

    fn sentences(&self, act: &AuxiliaryAct) -> Vec<Rich> {
        let of_forces = self.of_masses(act).or_else(|| self.of_lever(act));
        of_forces.unwrap_or_else(|| self.act(act).into_iter().collect())
    }

    fn act(&self, act: &AuxiliaryAct) -> Option<Rich> {
        let n = self.notation;
        let words = n.words;
        let image = |label, order| n.image(label, order);
        let label = |point: PointId| Label::Image { point, link: None };
        let pole = Label::Pole;
        let omega = |link: LinkId| n.symbol(Quantity::Omega(link), false);
        let named = |own: PointName| name(own, n);
        let text = match *act {
            AuxiliaryAct::CrankAsImage { crank, omega: rate, velocity, acceleration } => {
                let parts = [
                    ("crank", n.length(crank.pivot, crank.crank_pin)),
                    ("pivot", n.point(crank.pivot)),
                    ("pin", n.point(crank.crank_pin)),
                    ("pole", image(pole, DiagramKind::Velocity)),
                    ("image", image(label(crank.crank_pin), DiagramKind::Velocity)),
                    ("velocity", n.symbol(Quantity::Velocity(crank.crank_pin), false)),
                    ("omega", omega(crank.crank)),
                    ("rate", self.rate_of_scale(crank.crank, rate)),
                    ("scale", scale_that_follows(velocity, Dimension::Velocity, n)),
                ];
                let mut text = Rich::fill(words.klein_crank, &parts);
                if let Some(scale) = acceleration {
                    let parts = [
                        ("pole", image(pole, DiagramKind::Acceleration)),
                        ("image", image(label(crank.crank_pin), DiagramKind::Acceleration)),
                        ("omega", omega(crank.crank)),
                        ("scale", scale_that_follows(scale, Dimension::Acceleration, n)),
                    ];
                    text = text.up(" ").then(&Rich::fill(words.klein_crank_accelerations, &parts));
                }
                text
            }
            AuxiliaryAct::AcrossGuide { crank, crossing } => {
                let parts = [
                    ("pole", image(pole, DiagramKind::Velocity)),
                    ("guide", n.guide(crank.slide)),
                    ("rod", n.length(crank.crank_pin, crank.slider_pin)),
                    ("image", image(label(crank.slider_pin), DiagramKind::Velocity)),
                ];
                steps::warned(Rich::fill(words.klein_across, &parts), crossing, n)
            }
            AuxiliaryAct::NormalOnRod { crank, proportion } => {
                let own = |p| label(p);
                let parts = [
                    ("rod", n.length(crank.crank_pin, crank.slider_pin)),
                    ("pin", n.point(crank.crank_pin)),
                    ("end", n.point(crank.slider_pin)),
                    (
                        "opening",
                        n.image_line(own(crank.crank_pin), own(crank.slider_pin), DiagramKind::Velocity),
                    ),
                    ("foot", image(foot(crank.slider_pin), DiagramKind::Acceleration)),
                ];
                let template = match proportion {
                    Proportion::Chord => words.klein_chord,
                    Proportion::Tangent => words.klein_tangent,
                };
                Rich::fill(template, &parts)
            }
            AuxiliaryAct::TangentialOnCrank { crank, mm } => {
                let parts = [
                    ("crank", n.length(crank.pivot, crank.crank_pin)),
                    ("pin", n.point(crank.crank_pin)),
                    ("alpha", n.symbol(Quantity::Alpha(crank.crank), false)),
                    ("omega", omega(crank.crank)),
                    ("mm", human::millimetres(mm)),
                    ("image", image(label(crank.crank_pin), DiagramKind::Acceleration)),
                    ("foot", image(foot(crank.slider_pin), DiagramKind::Acceleration)),
                ];
                Rich::fill(words.klein_gathering, &parts)
            }
            AuxiliaryAct::AlongGuide { crank, crossing } => {
                let parts = [
                    ("pole", image(pole, DiagramKind::Acceleration)),
                    ("guide", n.guide(crank.slide)),
                    ("foot", image(foot(crank.slider_pin), DiagramKind::Acceleration)),
                    ("rod", n.length(crank.crank_pin, crank.slider_pin)),
                    ("image", image(label(crank.slider_pin), DiagramKind::Acceleration)),
                ];
                steps::warned(Rich::fill(words.klein_along, &parts), crossing, n)
            }
            AuxiliaryAct::ReadTurned { crank, accelerations } => {
                let parts = [("omega", omega(crank.crank))];
                let text = Rich::fill(words.klein_turned, &parts);
                if !accelerations {
                    return Some(text);
                }
                let parts = [
                    ("pole", image(pole, DiagramKind::Acceleration)),
                    ("image", image(label(crank.slider_pin), DiagramKind::Acceleration)),
                    ("acceleration", n.symbol(Quantity::Acceleration(crank.slider_pin), false)),
                ];
                text.up(" ").then(&Rich::fill(words.klein_reversed, &parts))
            }
            AuxiliaryAct::ReadImage { quantity, tail, head, mm, si_per_mm } => {
                let order = quantity.order();
                let unit = n.unit(order.dimension());
                let (factor, written) = human::factor(si_per_mm / unit.si);
                let exact = mm * si_per_mm / unit.si;
                let (reading, amount, number) = human::reading_at(mm, written, exact, 0);
                self.figures.borrow_mut().note(Key::of(quantity, n), &amount, (number, exact), &unit);
                let reading = reading
                    .up("\u{a0}×\u{a0}")
                    .then(&factor)
                    .up("\u{a0}=\u{a0}")
                    .then(&human::with_unit(&amount, &unit.symbol));
                let parts = [
                    ("vector", n.symbol(quantity, false)),
                    ("image", n.image_line(tail, head, order.diagram())),
                    ("reading", reading),
                ];
                Rich::fill(words.read_vector, &parts)
            }
            AuxiliaryAct::Calculate(calculation) => {
                return steps::calculation(&calculation, self.construction, n, self.figures);
            }
            AuxiliaryAct::PoleByNormals { link, points, crossing } => {
                let parts = [
                    ("first", n.point(points[0])),
                    ("second", n.point(points[1])),
                    ("link", Rich::upright(n.number(link))),
                    ("pole", named(PointName::Centre(crate::plan::chord(LinkId::FRAME, link)))),
                ];
                steps::warned(Rich::fill(words.inflection_normals, &parts), crossing, n)
            }
            AuxiliaryAct::InflectionPoint { link, point, by } => self.inflection_point(link, point, by),
            AuxiliaryAct::InflectionCircle { link, points, mm, diameter } => {
                let parts = [
                    ("first", named(PointName::Inflection(points[0]))),
                    ("second", named(PointName::Inflection(points[1]))),
                    ("pole", named(PointName::Centre(crate::plan::chord(LinkId::FRAME, link)))),
                    ("summit", named(PointName::InflectionPole)),
                    ("link", Rich::upright(n.number(link))),
                    ("mm", human::millimetres(mm)),
                    ("value", human::quantity(diameter, &n.scene.units.length)),
                ];
                // Nobody measures what is not on his paper.
                let beyond = self.lies_beyond(PointName::InflectionPole);
                let template = if beyond { words.inflection_circle_beyond } else { words.inflection_circle };
                Rich::fill(template, &parts)
            }
            AuxiliaryAct::AccelerationCentre { link, omega: rate, alpha, angle } => {
                let parts = [
                    ("pole", named(PointName::Centre(crate::plan::chord(LinkId::FRAME, link)))),
                    ("summit", named(PointName::InflectionPole)),
                    ("centre", named(PointName::AccelerationCentre)),
                    ("alpha", n.symbol(Quantity::Alpha(link), false)),
                    ("omega", omega(link)),
                    ("ratio", human::number(alpha.abs() / (rate * rate))),
                    ("angle", human::degrees(angle.abs())),
                    ("sense", Rich::upright(n.sense(alpha))),
                    ("link", Rich::upright(n.number(link))),
                ];
                let template =
                    if alpha == 0.0 { words.acceleration_centre_steady } else { words.acceleration_centre };
                Rich::fill(template, &parts)
            }
            AuxiliaryAct::TrialCentre { links: [i, j, k] } => {
                let centre = |a, b| named(PointName::Centre(crate::plan::chord(a, b)));
                let parts = [
                    ("first", centre(i, j)),
                    ("second", centre(i, k)),
                    ("third", centre(j, k)),
                    ("trial", named(PointName::Trial)),
                ];
                Rich::fill(words.kennedy_trial, &parts)
            }
            AuxiliaryAct::TrialVelocities { links: [i, j, k] } => {
                let centre = |a, b| named(PointName::Centre(crate::plan::chord(a, b)));
                let trial = || named(PointName::Trial);
                let number = |l| Rich::upright(n.number(l));
                let parts = [
                    ("trial", trial()),
                    ("base", number(i)),
                    ("one", number(j)),
                    ("other", number(k)),
                    ("first", trial().then(&centre(i, j))),
                    ("second", trial().then(&centre(i, k))),
                ];
                Rich::fill(words.kennedy_velocities, &parts)
            }
            AuxiliaryAct::OneLine { links: [i, j, k] } => {
                let centre = |a, b| named(PointName::Centre(crate::plan::chord(a, b)));
                let parts = [("line", centre(i, j).then(&centre(i, k))), ("third", centre(j, k))];
                Rich::fill(words.kennedy_line, &parts)
            }
            AuxiliaryAct::OtherPosition { link, to } => {
                let input = n.mechanism().inputs.first()?;
                let value = match input {
                    Input::Slide { .. } => human::quantity(to, &n.scene.units.length),
                    Input::Angle { .. } | Input::Speed { .. } => human::degrees(to),
                };
                let parts = [("value", value), ("link", Rich::upright(n.number(link)))];
                Rich::fill(words.rotation_other, &parts)
            }
            AuxiliaryAct::Bisectors { points: [a, b], crossing, .. } => {
                let way = |p| n.point(p).then(&named(PointName::Moved(p)));
                let parts =
                    [("first", way(a)), ("second", way(b)), ("centre", named(PointName::RotationCentre))];
                steps::warned(Rich::fill(words.rotation_bisectors, &parts), crossing, n)
            }
            AuxiliaryAct::Rotation { link, point, angle } => {
                let parts = [
                    ("link", Rich::upright(n.number(link))),
                    ("angle", human::degrees(angle.abs())),
                    ("sense", Rich::upright(n.sense(angle))),
                    ("centre", named(PointName::RotationCentre)),
                    ("before", n.point(point)),
                    ("after", named(PointName::Moved(point))),
                ];
                Rich::fill(words.rotation_angle, &parts)
            }
            AuxiliaryAct::Loci { links, within } => {
                let number = |l| Rich::upright(n.number(l));
                let parts = [
                    ("centre", named(PointName::Centre(crate::plan::chord(links[0], links[1])))),
                    ("fixed", number(links[0])),
                    ("moving", number(links[1])),
                    ("within", human::stated(within).up("\u{a0}mm")),
                ];
                Rich::fill(words.centrodes_loci, &parts)
            }
            AuxiliaryAct::SecondMass { .. }
            | AuxiliaryAct::MassesAtPins { .. }
            | AuxiliaryAct::ImageOfSecond { .. }
            | AuxiliaryAct::LinesOfMasses { .. }
            | AuxiliaryAct::OneMassRests { .. }
            | AuxiliaryAct::LinesApart { .. }
            | AuxiliaryAct::CorrectingCouple { .. }
            | AuxiliaryAct::LineOfInertia { .. }
            | AuxiliaryAct::TurnedPolygon
            | AuxiliaryAct::MomentOnLever { .. }
            | AuxiliaryAct::NoArmOnLever { .. }
            | AuxiliaryAct::CoupleOnLever { .. }
            | AuxiliaryAct::EffortOfLever { .. } => return None,
        };
        Some(text)
    }

    /// What is done with two masses in the place of a link.
    fn of_masses(&self, act: &AuxiliaryAct) -> Option<Vec<Rich>> {
        let n = self.notation;
        let words = n.words;
        let centre = |link: LinkId| n.mechanism().forces.mass(link).map(|mass| mass.centre);
        let own = |letter: &str, link: LinkId| Rich::italic(letter).sub(&n.number(link));
        let second = |point: Option<PointId>| {
            point.map_or_else(|| name(PointName::SecondMass, n), |point| n.point(point))
        };
        let length = |metres: f64| human::quantity(metres, &n.scene.units.length);
        let h = |number: &str| Rich::italic("h").sub(number);
        Some(vec![match *act {
            AuxiliaryAct::SecondMass { link, first, mass, inertia, arms: [near, beyond] } => {
                let parts = [
                    ("link", Rich::upright(n.number(link))),
                    ("first", n.point(first)),
                    ("second", second(None)),
                    ("centre", n.point(centre(link)?)),
                    ("h2", h("2")),
                    ("near", h("1").up(EQUALS).then(&length(near))),
                ];
                let stated = n.mechanism().forces.mass(link)?;
                let (formula, numbers) = match stated.inertia {
                    Inertia::Gyration(radius) => {
                        let written = human::closing([radius.value, near], beyond, |[r, x]| r * r / x);
                        let [r, x] = written;
                        (own("ρ", link).squared().up(OVER).then(&h("1")), r.up("²").up(OVER).then(&x))
                    }
                    _ => {
                        let written = human::closing([inertia, mass, near], beyond, |[i, m, x]| i / (m * x));
                        let [i, m, x] = written;
                        let below = own("M", link).up(DOT).then(&h("1"));
                        (
                            own("I", link).up(OVER).up("(").then(&below).up(")"),
                            i.up(OVER).up("(").then(&m).up(TIMES).then(&x).up(")"),
                        )
                    }
                };
                let line = h("2").up(EQUALS).then(&formula).up(EQUALS).then(&numbers).up(EQUALS);
                let line = line.then(&human::with_unit(&human::number(beyond), "m"));
                let own_unit = &n.scene.units.length;
                let line = match (own_unit.si - 1.0).abs() < 1e-12 {
                    true => line,
                    false => line.up(EQUALS).then(&length(beyond)),
                };
                let mut lines = vec![Rich::fill(words.masses_second, &parts)];
                lines.extend(self.mass_of_weight(stated, mass));
                lines.push(line);
                return Some(lines);
            }
            AuxiliaryAct::MassesAtPins { link, pins: [a, b], arms } => {
                let parts = [
                    ("link", Rich::upright(n.number(link))),
                    ("first", n.point(a)),
                    ("second", n.point(b)),
                    ("centre", n.point(centre(link)?)),
                    ("a", Rich::italic("a").up(EQUALS).then(&length(arms[0]))),
                    ("b", Rich::italic("b").up(EQUALS).then(&length(arms[1]))),
                ];
                Rich::fill(words.masses_at_pins, &parts)
            }
            AuxiliaryAct::ImageOfSecond { link, first } => {
                let label = |point| Label::Image { point, link: None };
                let line = n.image_line(label(first), label(centre(link)?), DiagramKind::Acceleration);
                let parts = [
                    ("line", line),
                    ("image", name(PointName::ImageOfSecond, n)),
                    ("second", second(None)),
                    ("ratio", h("2").up("\u{a0}:\u{a0}").then(&h("1"))),
                ];
                Rich::fill(words.masses_image, &parts)
            }
            AuxiliaryAct::LinesOfMasses { link, first, second: other, crossing } => {
                let parts = [
                    ("first", n.point(first)),
                    ("second", second(other)),
                    ("meet", name(PointName::MeetOfMasses, n)),
                    ("force", name(PointName::InertiaForce(link), n)),
                    ("acceleration", n.symbol(Quantity::Acceleration(centre(link)?), false)),
                ];
                steps::warned(Rich::fill(words.masses_lines, &parts), crossing, n)
            }
            AuxiliaryAct::OneMassRests { link, rests, acts } => {
                let parts = [
                    ("rests", second(rests)),
                    ("acts", second(acts)),
                    ("force", name(PointName::InertiaForce(link), n)),
                    ("acceleration", n.symbol(Quantity::Acceleration(centre(link)?), false)),
                ];
                Rich::fill(words.mass_rests, &parts)
            }
            AuxiliaryAct::LinesApart { link } => {
                let torque = force_symbol(Force::InertiaTorque(link), n);
                let force = name(PointName::InertiaForce(link), n);
                let ratio =
                    name(PointName::OffsetOfInertia(link), n).up(EQUALS).then(&torque).up(OVER).then(&force);
                let parts = [
                    ("force", name(PointName::InertiaForce(link), n)),
                    ("ratio", ratio),
                    ("centre", n.point(centre(link)?)),
                ];
                Rich::fill(words.masses_apart, &parts)
            }
            AuxiliaryAct::CorrectingCouple { link, pins, mass, inertia, arms: [a, b], alpha, couple } => {
                let couple_symbol = Rich::italic("T").sub("c");
                let rate = n.symbol(Quantity::Alpha(link), false);
                let formula = Rich::upright("(")
                    .then(&own("M", link))
                    .up(DOT)
                    .it("a")
                    .up(DOT)
                    .it("b")
                    .up(" − ")
                    .then(&own("I", link))
                    .up(")")
                    .up(DOT)
                    .then(&rate);
                let factors = [mass, a, b, inertia, alpha.abs()];
                let written = human::closing_all(&factors, couple.abs(), |x| {
                    ((x[0] * x[1] * x[2] - x[3]) * x[4]).abs()
                });
                let numbers = Rich::upright("(")
                    .then(&written[0])
                    .up(TIMES)
                    .then(&written[1])
                    .up(TIMES)
                    .then(&written[2])
                    .up(" − ")
                    .then(&written[3])
                    .up(")")
                    .up(TIMES)
                    .then(&written[4]);
                let against = mass * a * b < inertia;
                let value = human::number(if against { -couple.abs() } else { couple.abs() });
                let line = couple_symbol
                    .up(EQUALS)
                    .then(&formula)
                    .up(EQUALS)
                    .then(&numbers)
                    .up(EQUALS)
                    .then(&human::with_unit(&value, "N·m"));
                let parts = [
                    ("first", n.point(pins[0])),
                    ("second", n.point(pins[1])),
                    ("force", name(PointName::InertiaForce(link), n)),
                    ("rotation", rate),
                ];
                let template = if against { words.masses_couple_against } else { words.masses_couple_with };
                return Some(vec![Rich::fill(template, &parts), line]);
            }
            AuxiliaryAct::LineOfInertia { link, mass, size, arm } => {
                let offset = name(PointName::OffsetOfInertia(link), n);
                let acceleration = n.symbol(Quantity::Acceleration(centre(link)?), false);
                let [m, a] = human::closing([mass, size / mass], size, |[m, a]| m * a);
                let force = name(PointName::InertiaForce(link), n).up(EQUALS).then(&own("M", link)).up(DOT);
                let force = force.then(&acceleration).up(EQUALS).then(&m).up(TIMES).then(&a).up(EQUALS);
                let force = force.then(&human::with_unit(&human::number(size), "N"));
                let force = match (n.scene.units.force.si - 1.0).abs() < 1e-12 {
                    true => force,
                    false => force.up(EQUALS).then(&human::quantity(size, &n.scene.units.force)),
                };
                let parts = [
                    ("force", force),
                    ("acceleration", n.symbol(Quantity::Acceleration(centre(link)?), false)),
                    ("centre", n.point(centre(link)?)),
                    ("arm", offset.up(EQUALS).then(&length(arm))),
                ];
                Rich::fill(words.masses_through, &parts)
            }
            _ => return None,
        }])
    }

    /// The mass of a link of which the weight is stated.
    fn mass_of_weight(&self, stated: &Mass, mass: f64) -> Option<Rich> {
        let Heaviness::Weight(weight) = stated.heaviness else { return None };
        let n = self.notation;
        let own = |letter: &str| Rich::italic(letter).sub(&n.number(stated.link));
        let g = n.mechanism().forces.gravity.g.value;
        let [w, g] = human::closing([weight.value, g], mass, |[w, g]| w / g);
        let line = own("M").up(EQUALS).then(&own("W")).up(OVER).it("g").up(EQUALS).then(&w).up(OVER).then(&g);
        Some(line.up(EQUALS).then(&human::with_unit(&human::number(mass), "kg")))
    }

    /// What is done with the lever; moments are powers, and powers are told in watts.
    fn of_lever(&self, act: &AuxiliaryAct) -> Option<Vec<Rich>> {
        let n = self.notation;
        let words = n.words;
        let si = |symbol: &str| Unit { symbol: symbol.to_owned(), si: 1.0 };
        let watt = si("W");
        // A force stands as the balance told it, in newtons.
        let of_force = |action: Action| match action {
            Action::Weight(link) if n.mechanism().shared_by(link) == 1.0 => Key::OfLink("W", link),
            _ => Key::of(Quantity::Force(Force::Vector(action), Share::Total), n),
        };
        let omega = |link: LinkId| n.symbol(Quantity::Omega(link), false);
        let pole = || n.image(Label::Pole, DiagramKind::Velocity);
        Some(vec![match *act {
            AuxiliaryAct::TurnedPolygon => Rich::fill(words.lever_turned, &[("pole", pole())]),
            AuxiliaryAct::MomentOnLever { action, number, size, mm, si_per_mm, moment } => {
                let arm = name(PointName::LeverArm(number), n);
                let force = force_symbol(Force::Vector(action), n);
                // By the scale of velocities the arm is the part of the velocity along the force.
                let (factor, written) = human::factor(si_per_mm);
                let (newton, millimetre) = (si("N"), Unit { symbol: "mm".to_owned(), si: 1.0 });
                let factors = [(Some(of_force(action)), size, &newton), (None, mm, &millimetre)];
                let told = (Some(Key::Power(Force::Vector(action))), moment.abs(), &watt);
                let reckon = |x: &[f64]| x[0] * x[1] * written;
                let (x, text, _) = self.figures.borrow_mut().line_of(&factors, told, reckon);
                let product = force.up(DOT).then(&arm).up(EQUALS).then(&x[0]).up(TIMES);
                let product = product.then(&human::with_unit(&x[1], "mm")).up(TIMES).then(&factor).up(EQUALS);
                product.then(&human::with_unit(&text, &watt.symbol)).word(n.sense(moment))
            }
            AuxiliaryAct::NoArmOnLever { action } => {
                let parts = [("force", force_symbol(Force::Vector(action), n)), ("pole", pole())];
                Rich::fill(words.lever_no_arm, &parts)
            }
            AuxiliaryAct::CoupleOnLever { of, link, torque, omega: rate } => {
                let moment = torque * rate;
                // What turns twice has one number.
                let factors = [
                    (Some(Key::Of(Quantity::Force(of, Share::Total))), torque, &si("N·m")),
                    (Some(Key::of(Quantity::Omega(link), n)), rate, &si("rad/s")),
                ];
                let told = (Some(Key::Power(of)), moment.abs(), &watt);
                let (x, text, _) = self.figures.borrow_mut().line_of(&factors, told, |x| x[0] * x[1]);
                let line = force_symbol(of, n).up(DOT).then(&omega(link)).up(EQUALS);
                let line = line.then(&x[0]).up(TIMES).then(&x[1]).up(EQUALS);
                let line = line.then(&human::with_unit(&text, &watt.symbol));
                let parts = [("link", Rich::upright(n.number(link))), ("moment", line.word(n.sense(moment)))];
                Rich::fill(words.lever_couple, &parts)
            }
            AuxiliaryAct::EffortOfLever { of, moments, speed, effort } => {
                let symbol = force_symbol(of, n);
                let (Force::Torque(input) | Force::Drive(input)) = of else { return None };
                let driven = n.mechanism().driven_link(input);
                let point = n.mechanism().driven_point(input);
                let rate = match driven {
                    Some(link) => omega(link),
                    None => n.symbol(Quantity::Velocity(point?), false),
                };
                let (own, of_rate, rate_unit) = match driven {
                    Some(link) => (si("N·m"), Quantity::Omega(link), si("rad/s")),
                    None => (si("N"), Quantity::Velocity(point?), si("m/s")),
                };
                let of_act = |act: &AuxiliaryAct| match *act {
                    AuxiliaryAct::MomentOnLever { action, moment, .. } => {
                        Some((Force::Vector(action), moment))
                    }
                    AuxiliaryAct::CoupleOnLever { of, torque, omega, .. } => Some((of, torque * omega)),
                    _ => None,
                };
                let terms: Vec<(Force, f64)> = self.drawing.acts.iter().filter_map(of_act).collect();
                let mut figures = self.figures.borrow_mut();
                // As the other way to it can tell it.
                let [all, result] = [Key::Given("ΣM"), Key::Power(of)];
                let rate_key = Key::of(of_rate, n);
                [all, rate_key, result].into_iter().for_each(|key| figures.want_one(key));
                let mut sum = Rich::upright("Σ").it("M").up(EQUALS);
                let told = match terms[..] {
                    [(only, _)] => {
                        figures.alias(all, Key::Power(only));
                        let text = figures.tell(all, moments, &watt);
                        Rich::upright(if moments < 0.0 { "−" } else { "" }).then(&text)
                    }
                    _ => {
                        let factors: Vec<_> =
                            terms.iter().map(|(of, power)| (Some(Key::Power(*of)), *power, &watt)).collect();
                        let reckon = |sizes: &[f64]| {
                            sizes.iter().zip(&terms).map(|(size, (_, term))| size.copysign(*term)).sum()
                        };
                        let (written, text, _) =
                            figures.line_of(&factors, (Some(all), moments, &watt), reckon);
                        for (place, (text, (_, term))) in written.iter().zip(&terms).enumerate() {
                            let sign = match (place, *term < 0.0) {
                                (0, false) => "",
                                (0, true) => "−",
                                (_, false) => " + ",
                                (_, true) => " − ",
                            };
                            sum = sum.up(sign).then(text);
                        }
                        sum = sum.up(EQUALS);
                        text
                    }
                };
                let sum = sum.then(&told).up("\u{a0}W");
                let factors = [(Some(all), moments, &watt), (Some(rate_key), speed, &rate_unit)];
                // A torque has its sense beside it, and its size alone before that.
                let by_sense = driven.is_some() && (effort < 0.0 || speed < 0.0);
                let reckon = |x: &[f64]| match by_sense {
                    true => x[0] / x[1],
                    false => x[0].copysign(-moments) / x[1].copysign(speed),
                };
                let size = if by_sense { effort.abs() } else { effort };
                let (x, text, _) = figures.line_of(&factors, (Some(result), size, &own), reckon);
                // The table says what this line says.
                if let Some(print) = figures.print_of(result).cloned() {
                    let asked = Key::of(Quantity::Force(of, Share::Total), n);
                    figures.keep_result(Method::Lever, asked, print);
                }
                let sign = |value: f64| if value < 0.0 { "−" } else { "" };
                let line = match by_sense {
                    true => {
                        let line = symbol.up(EQUALS).up("|Σ").it("M").up("|").up(OVER).up("|").then(&rate);
                        line.up("|").up(EQUALS).then(&x[0]).up(OVER).then(&x[1]).up(EQUALS)
                    }
                    false => {
                        let line = symbol.up(EQUALS).up("−Σ").it("M").up(OVER).then(&rate).up(EQUALS);
                        line.up(sign(-moments)).then(&x[0]).up(OVER).up(sign(speed)).then(&x[1]).up(EQUALS)
                    }
                };
                let line = line.then(&human::with_unit(&text, &own.symbol));
                let line = if driven.is_some() { line.word(n.sense(effort)) } else { line };
                return Some(vec![
                    Rich::fill(words.lever_sum, &[("sum", sum), ("pole", pole())]),
                    Rich::fill(words.lever_effort, &[("effort", line)]),
                ]);
            }
            _ => return None,
        }])
    }

    fn inflection_point(&self, link: LinkId, point: PointId, by: InflectionBy) -> Rich {
        let n = self.notation;
        let words = n.words;
        let own = || n.point(point);
        let found = name(PointName::Inflection(point), n);
        let pole = name(PointName::Centre(crate::plan::chord(LinkId::FRAME, link)), n);
        let proportional = |centre: Rich, proportion| {
            let parts = [
                ("point", own()),
                ("pole", pole.clone()),
                ("radius", own().then(&centre)),
                ("centre", centre),
                ("found", found.clone()),
            ];
            let template = match proportion {
                Proportion::Chord => words.inflection_chord,
                Proportion::Tangent => words.inflection_tangent,
            };
            Rich::fill(template, &parts)
        };
        match by {
            InflectionBy::Pivot { pivot, proportion } => proportional(n.point(pivot), proportion),
            InflectionBy::Arc { slide, proportion } => {
                let centre = Rich::fill(words.centre_of_guide, &[("guide", n.guide(slide))]);
                proportional(centre, proportion)
            }
            InflectionBy::Straight { .. } => {
                Rich::fill(words.inflection_straight, &[("point", own()), ("found", found)])
            }
            InflectionBy::Acceleration { normal, mm } => {
                let unit = n.unit(Dimension::Acceleration);
                let parts = [
                    ("point", own()),
                    ("pole", pole),
                    ("normal", n.symbol(Quantity::Normal(point), false)),
                    ("value", human::quantity(normal.abs(), &unit)),
                    ("omega", n.symbol(Quantity::Omega(link), false)),
                    ("mm", human::millimetres(mm.abs())),
                    ("found", found),
                ];
                let template = if mm < 0.0 { words.inflection_away } else { words.inflection_toward };
                Rich::fill(template, &parts)
            }
        }
    }

    /// What turns, as it was told before.
    fn rate(&self, link: LinkId, omega: f64) -> Rich {
        let (n, quantity) = (self.notation, Quantity::Omega(link));
        let unit = n.angular_unit(Order::Velocity);
        let told = self.figures.borrow_mut().tell(Key::of(quantity, n), omega, &unit);
        n.with_sense(human::with_unit(&told, &unit.symbol), omega)
    }

    /// The same of a rate from which a scale follows: it has the figures of the scale.
    fn rate_of_scale(&self, link: LinkId, omega: f64) -> Rich {
        self.figures.borrow_mut().want_for_scale(Key::of(Quantity::Omega(link), self.notation));
        self.rate(link, omega)
    }
}

fn foot(point: PointId) -> Label {
    Label::Foot { point, link: None, index: 2 }
}
