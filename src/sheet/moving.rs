//! The diagrams taken apart, for whoever moves them: their ink without its names, and the names to be placed along a course.
//!
//! Nothing here knows how anything moves. The ink of one diagram is drawn for any position by the same code as on a sheet.

use kurbo::{Line, ParamCurveNearest, Point, Rect, Vec2};

use super::circle;
use super::feet::told_apart;
use super::figure::{Group, Life, Mark, Pen, Shape, Tone};
use super::growth::Births;
pub use super::ink::arrow;
use super::ink::{FINE, SMALL, THICK, THIN, dot, page};
use super::labels::{Obstacles, Request, Site, crossing};
use super::notation::Notation;
use super::overlap::clip;
use super::panels::{self, Panel};
use super::rich::Rich;
pub use super::slots::Opening;
use super::steps::{self, Item, WAY};
use super::words::Language;
use super::{auxiliary, human, polygon, skeleton, transfer};
use crate::graphical::auxiliary::{StrokeRole, StrokeShape};
use crate::graphical::construction::{
    Act, CentreLine, CentrePlace, CircleDiagram, Claim, Construction, Found, Label, Reference, Transfer,
    TransferInk, Vector, VectorKind,
};
use crate::mechanism::quantity::{DiagramKind, Dimension, Quantity, Unit};
use crate::mechanism::{LinkId, PointId, Rider};
use crate::plan::chord;
use crate::scene::Scene;

/// A diagram without its names.
#[derive(Debug, Clone)]
pub struct Drawing {
    /// Which.
    pub kind: DiagramKind,
    /// Its ink, the first fixed point or the pole at the origin; in a polygon every group tells by its identifier what it
    /// is (see [`crate::graphical::construction::Diagram`]): `v3` the third vector, `r` a line, `p` an image, `l` a link.
    pub ink: Group,
    /// The names of a skeleton; those of a polygon are asked for with [`Draughts::name_of_images`] and
    /// [`Draughts::name_of_vectors`].
    pub names: Vec<Name>,
    /// The slots of a skeleton that let their pins go.
    pub openings: Vec<Opening>,
    /// Its caption, as hypertext.
    pub title: String,
}

/// What is drawn over a skeleton: lines of centres, a construction besides the polygons.
#[derive(Debug, Clone)]
pub struct Layer {
    /// The name of its figure.
    pub figure: &'static str,
    /// Its caption, as hypertext.
    pub title: String,
    /// Its strokes, in the same order in every position.
    pub strokes: Vec<LayerStroke>,
    /// Its points that have a name or a mark.
    pub points: Vec<LayerPoint>,
    /// Names that stand beside what is drawn from point to point.
    pub names: Vec<LayerName>,
    /// The scales of what is drawn over the skeleton to another scale than this has.
    pub scales: Vec<LayerScale>,
}

/// A name in a layer beside what is drawn between two points.
#[derive(Debug, Clone)]
pub struct LayerName {
    /// The points; none for one that is at infinity.
    pub at: [Option<Point>; 2],
    /// The name.
    pub name: Name,
}

/// A scale in a layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerScale {
    /// What is drawn to it.
    pub dimension: Dimension,
    /// SI units for a millimetre.
    pub si_per_mm: f64,
    /// It was not chosen: it follows from another one.
    pub follows: bool,
}

/// A stroke of a layer.
#[derive(Debug, Clone)]
pub struct LayerStroke {
    /// How its points make it.
    pub way: Way,
    /// The points; none for one that is at infinity.
    pub at: Vec<Option<Point>>,
    /// Its pen.
    pub pen: Pen,
    /// Its class.
    pub class: &'static str,
    /// What it carries, as the data of the ink call it.
    pub of: String,
}

/// How points make a stroke.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Way {
    /// From the first to the last.
    Line,
    /// Through all that are on the paper, and a little past the outermost.
    Through,
    /// From the first to the last, as far as that is on the paper.
    Within,
    /// An arrow from the first to the last.
    Arrow,
    /// A circle with this radius about the first.
    Circle(f64),
}

/// A point of a layer.
#[derive(Debug, Clone)]
pub struct LayerPoint {
    /// Where it is; nothing where it is at infinity.
    pub at: Option<Point>,
    /// Its name.
    pub name: Option<Name>,
    /// Its mark, about the origin.
    pub ink: Group,
}

/// A name that is to be placed.
#[derive(Debug, Clone)]
pub struct Name {
    request: Request,
}

/// What a name stands by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Spot {
    /// A point.
    Point(Point),
    /// A stroke.
    Stroke(Point, Point),
}

impl Spot {
    /// The point from which the place of the name is told.
    #[must_use]
    pub fn anchor(self) -> Point {
        match self {
            Self::Point(at) => at,
            Self::Stroke(from, to) => from.midpoint(to),
        }
    }
}

impl Name {
    /// What it names, as the `data-` attributes of that ink call it.
    #[must_use]
    pub fn of(&self) -> &[String] {
        &self.request.names
    }

    /// When it came onto the paper, where that is known.
    #[must_use]
    pub fn life(&self) -> Option<Life> {
        self.request.life
    }

    /// Its class.
    #[must_use]
    pub fn class(&self) -> &'static str {
        self.request.class
    }

    /// Whether it says the same of the same.
    #[must_use]
    pub fn is_like(&self, other: &Self) -> bool {
        let (own, other) = (&self.request, &other.request);
        own.class == other.class && own.names == other.names && own.text == other.text
    }

    /// What it stands by in the diagram that was drawn.
    #[must_use]
    pub fn spot(&self) -> Spot {
        match self.request.sites.first() {
            Some(Site::Around { at, .. }) => Spot::Point(*at),
            Some(Site::Along { from, to }) => Spot::Stroke(*from, *to),
            None => Spot::Point(Point::ORIGIN),
        }
    }

    /// Its ink, the middle of it at the origin, and half its width and height.
    #[must_use]
    pub fn ink(&self) -> (Group, Vec2) {
        let line = self.request.text.set(self.request.size);
        let middle = line.ink.center();
        let mut group = Group::new("name");
        if !self.request.names.is_empty() {
            group = group.data("of", self.request.names.join(" "));
        }
        if let Some(radius) = self.request.ring {
            let circle = Shape::Circle { centre: Point::ORIGIN, radius };
            group.mark(Mark::stroke(circle, Pen::solid(0.18)).class("ring"));
        }
        line.put(&mut group, Point::ORIGIN - middle.to_vec2(), self.request.class);
        (group, self.half())
    }

    fn half(&self) -> Vec2 {
        if let Some(radius) = self.request.ring {
            return Vec2::new(radius, radius);
        }
        let ink = self.request.text.set(self.request.size).ink;
        Vec2::new(ink.width() / 2.0, ink.height() / 2.0)
    }

    /// How far what it names reaches around a point.
    fn radius(&self) -> f64 {
        match self.request.sites.first() {
            Some(Site::Around { radius, .. }) => *radius,
            _ => 0.0,
        }
    }
}

/// What is said of a step, as hypertext.
#[derive(Debug, Clone, PartialEq)]
pub struct Said {
    /// Index of the step; of several under one head the last.
    pub step: usize,
    /// Its head.
    pub head: String,
    /// Vector equations: the terms, each with what is known of it before the step is drawn.
    pub equations: Vec<Vec<Vec<String>>>,
    /// What is said of the position.
    pub sentences: Vec<Sentence>,
}

/// A sentence of a step.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sentence {
    /// As hypertext; nothing where a vector of another length would have a sentence here.
    pub text: String,
    /// Index of the act that it tells; none of what is calculated.
    pub act: Option<usize>,
    /// Its words hang on how long a vector is on paper: it lays one off, or reads one.
    pub is_of_length: bool,
}

/// How long every vector is taken to be on paper, for the words of what is laid off and read.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lengths {
    /// As it is.
    Drawn,
    /// An arrow.
    Arrow,
    /// Too short for an arrow.
    Point,
    /// Too short for a ruler.
    Unmeasured,
    /// Zero.
    Zero,
}

/// A construction of which every vector is taken to be so long. Nothing but what is said of it is of use.
fn taken(construction: &Construction, lengths: Lengths) -> Construction {
    let mut construction = construction.clone();
    if lengths == Lengths::Drawn {
        return construction;
    }
    for vector in construction.diagrams.iter_mut().flat_map(|diagram| &mut diagram.vectors) {
        vector.as_point = lengths != Lengths::Arrow;
        vector.is_zero = lengths == Lengths::Zero;
    }
    for act in construction.steps.iter_mut().flat_map(|step| &mut step.acts) {
        if let Act::LayOffVector { mm, .. } = act {
            match lengths {
                // Less than a ruler shows.
                Lengths::Unmeasured => *mm = 0.01,
                Lengths::Zero => *mm = 0.0,
                _ => {}
            }
        }
        if let (Act::ReadVector { value, .. }, Lengths::Zero) = (act, lengths) {
            *value = 0.0;
        }
    }
    construction
}

/// A construction, and how it is drawn.
#[derive(Debug)]
pub struct Draughts<'a> {
    construction: Construction,
    notation: Notation<'a>,
}

impl<'a> Draughts<'a> {
    /// The construction of a scene.
    #[must_use]
    pub fn new(scene: &'a Scene, construction: &Construction, language: Language) -> Self {
        let notation = Notation::new(scene, language.words());
        Self { construction: told_apart(construction, &notation), notation }
    }

    /// What is drawn, with a name of its own for each place.
    #[must_use]
    pub fn construction(&self) -> &Construction {
        &self.construction
    }

    /// The links that turn, each with whether it is its angular acceleration that is not zero.
    #[must_use]
    pub fn turning(&self) -> Vec<(LinkId, bool)> {
        skeleton::turning(&self.construction, &self.notation)
    }

    /// The diagrams that were drawn, with a curved arrow at each of the links that turn here or are named in `turning`.
    #[must_use]
    pub fn diagrams(&self, turning: &[(LinkId, bool)]) -> Vec<Drawing> {
        let (construction, notation) = (&self.construction, &self.notation);
        let births = Births::of(construction, notation.mechanism());
        let (ink, names, openings) = skeleton::apart(construction, notation, &births, turning);
        let names = names.into_iter().map(|request| Name { request }).collect();
        let mut all = vec![Drawing {
            kind: DiagramKind::Skeleton,
            ink,
            names,
            openings,
            title: self.title(DiagramKind::Skeleton),
        }];
        for diagram in &construction.diagrams {
            let Some(births) = births.images(diagram.kind) else { continue };
            let ink = polygon::apart(diagram, notation, births);
            let title = self.title(diagram.kind);
            let (names, openings) = (Vec::new(), Vec::new());
            all.push(Drawing { kind: diagram.kind, ink, names, openings, title });
        }
        all
    }

    /// What is drawn over the skeleton in figures of their own.
    #[must_use]
    pub fn layers(&self) -> Vec<Layer> {
        let mut all = Vec::new();
        if let Some(circle) = &self.construction.circle {
            all.push(self.centres(circle));
            for own in transfer::by_method(circle) {
                all.push(self.transfers(circle, &own));
            }
        }
        // The lever does not stand on the skeleton.
        let drawings = self.construction.auxiliary.iter();
        let drawings = drawings.filter(|drawing| drawing.refused.is_none() && !drawing.is_lever());
        all.extend(drawings.map(|drawing| self.auxiliary(drawing)));
        all
    }

    /// The circle diagram, which is the same in every position, and its caption.
    #[must_use]
    pub fn circle(&self) -> Option<(Group, String)> {
        let circle = self.construction.circle.as_ref()?;
        Some((circle::draw(circle, &self.notation), self.notation.words.circle_diagram.to_owned()))
    }

    fn centres(&self, found: &CircleDiagram) -> Layer {
        /// Of more centres than these the pins have no names.
        const NAMED: usize = 10;
        let notation = &self.notation;
        let on_paper = |links| on_paper(found, links);
        let mut strokes: Vec<LayerStroke> = Vec::new();
        for centre in &found.centres {
            let Found::Kennedy { lines } = centre.found else { continue };
            let [i, j] = centre.links;
            for line in lines {
                let (at, mut of) = match line {
                    CentreLine::Via(k) => {
                        let members = [chord(i, k), chord(k, j), centre.links];
                        (members.map(on_paper).to_vec(), members.to_vec())
                    }
                    CentreLine::Normal(slide) => {
                        let rider = notation.mechanism().slides.get(slide).map(|slide| slide.rider);
                        let pin = match rider {
                            Some(Rider::Pin { point, .. }) => self.construction.space.places[point.0],
                            _ => None,
                        };
                        (vec![pin.map(page), on_paper(centre.links)], vec![centre.links])
                    }
                };
                of.sort();
                let of: Vec<String> = of.iter().map(|links| circle::centre_name(*links, notation)).collect();
                let of = of.join(" ");
                let known = |stroke: &LayerStroke| stroke.of == of && at.len() == 3;
                if !strokes.iter().any(known) {
                    let (way, pen, class) = (Way::Through, Pen::solid(FINE), "line-of-centres");
                    strokes.push(LayerStroke { way, at, pen, class, of });
                }
            }
        }
        let mut points: Vec<LayerPoint> = Vec::new();
        let mut pins: Vec<(PointId, Vec<_>)> = Vec::new();
        for centre in &found.centres {
            match centre.found {
                Found::Pin(point) => match pins.iter_mut().find(|(own, _)| *own == point) {
                    Some((_, all)) => all.push(centre.links),
                    None => pins.push((point, vec![centre.links])),
                },
                _ => {
                    let mut ink =
                        Group::new("centre").data("centre", circle::centre_name(centre.links, notation));
                    if centre.links[0] == LinkId::FRAME {
                        let ring = Shape::Circle { centre: Point::ORIGIN, radius: 1.2 };
                        ink.mark(Mark::outlined(ring, Pen::solid(THIN), Tone::Paper).class("pole"));
                    }
                    ink.mark(dot(Point::ORIGIN, 0.55).class("centre"));
                    let name = self.name_of_centres(&[centre.links], 1.3);
                    points.push(LayerPoint { at: on_paper(centre.links), name: Some(name), ink });
                }
            }
        }
        if found.centres.len() <= NAMED {
            for (_, links) in pins {
                let at = links.first().and_then(|links| on_paper(*links));
                let name = self.name_of_centres(&links, skeleton::PIN + 0.2);
                points.push(LayerPoint { at, name: Some(name), ink: Group::default() });
            }
        }
        Layer {
            figure: "centres",
            title: notation.words.centres_figure.to_owned(),
            strokes,
            points,
            names: Vec::new(),
            scales: Vec::new(),
        }
    }

    fn name_of_centres(&self, links: &[[LinkId; 2]], radius: f64) -> Name {
        let texts: Vec<Rich> = links.iter().map(|links| circle::name(*links, &self.notation)).collect();
        let text = Rich::join(&texts, &Rich::upright(","));
        let names: Vec<String> =
            links.iter().map(|links| circle::centre_name(*links, &self.notation)).collect();
        let site = Site::Around { at: Point::ORIGIN, radius, toward: None };
        Name { request: Request::new(text, SMALL, site, "label centre-name").naming(names) }
    }

    fn transfers(&self, circle: &CircleDiagram, own: &[&Transfer]) -> Layer {
        let notation = &self.notation;
        let (mut strokes, mut points, mut names) = (Vec::new(), Vec::new(), Vec::new());
        let mut turned: Vec<PointId> = Vec::new();
        let mut has_arrows = false;
        for ink in transfer::strokes(own) {
            let (from, to) = transfer::ends(&ink);
            let mut add = |way, (from, to): (Point, Point), pen, class, of: String| {
                let at = vec![Some(from), Some(to)];
                strokes.push(LayerStroke { way, at, pen, class, of });
            };
            match ink {
                TransferInk::Arc { .. } => {}
                TransferInk::Velocity { .. } | TransferInk::Difference { .. } => {
                    let (symbol, quantity) = transfer::name_of_arrow(&ink, notation);
                    let of: Vec<String> = quantity.map(|of| notation.quantity_name(of)).into_iter().collect();
                    add(Way::Arrow, (from, to), Pen::solid(THICK), "velocity vector", of.concat());
                    let site = Site::Along { from, to };
                    let request = Request::new(symbol, SMALL, site, "label vector-name").naming(of);
                    names.push(LayerName { at: [Some(from), Some(to)], name: Name { request } });
                    has_arrows = true;
                }
                TransferInk::Turned { of, .. } => {
                    let pen = Pen::dashed(THIN);
                    add(Way::Arrow, (from, to), pen, "turned", String::new());
                    // A pin between two links is turned once, but for rounding.
                    if !turned.contains(&of) {
                        turned.push(of);
                        let site = Site::Around { at: to, radius: 0.6, toward: None };
                        let request = Request::new(notation.point(of).up("′"), SMALL, site, "label");
                        let name = Some(Name { request });
                        points.push(LayerPoint { at: Some(to), name, ink: Group::default() });
                    }
                    has_arrows = true;
                }
                TransferInk::Gauge { foot, .. } => {
                    add(Way::Within, (from, to), Pen::solid(FINE), "gauge-line", String::new());
                    // The line on which the arrows stand whose tips the gauge line joins.
                    add(Way::Within, (from, page(foot)), Pen::solid(FINE), "gauge-line", String::new());
                }
                TransferInk::LineOfCentres { .. } => {
                    add(Way::Within, (from, to), Pen::solid(FINE), "line-of-centres", String::new());
                }
                TransferInk::Radius { .. }
                | TransferInk::Upright { .. }
                | TransferInk::Parallel { .. }
                | TransferInk::ToPole { .. } => {
                    add(Way::Within, (from, to), Pen::solid(FINE), "construction", String::new());
                }
            }
        }
        points.extend(self.centres_used(circle, own));
        let scales = own.first().filter(|_| has_arrows).map(|first| LayerScale {
            dimension: Dimension::Velocity,
            si_per_mm: first.si_per_mm,
            follows: false,
        });
        let title = transfer::title(own, notation).html();
        let scales = scales.into_iter().collect();
        Layer { figure: "transfer", title, strokes, points, names, scales }
    }

    /// The centres by which velocities are carried over, with their names; those of one pin have one.
    fn centres_used(&self, circle: &CircleDiagram, own: &[&Transfer]) -> Vec<LayerPoint> {
        let mut used = transfer::used(own.iter().flat_map(|transfer| &transfer.acts));
        used.extend(transfer::poles_of_gauges(own, circle));
        used.sort();
        used.dedup();
        let mut all: Vec<(Option<PointId>, Vec<[LinkId; 2]>)> = Vec::new();
        for links in used {
            let pin = match circle.centre(links).map(|centre| centre.found) {
                Some(Found::Pin(point)) => Some(point),
                Some(_) => None,
                None => continue,
            };
            match all.iter_mut().find(|(other, _)| pin.is_some() && *other == pin) {
                Some((_, same)) => same.push(links),
                None => all.push((pin, vec![links])),
            }
        }
        all.into_iter()
            .map(|(pin, links)| {
                let at = links.first().and_then(|links| on_paper(circle, *links));
                let names: Vec<String> =
                    links.iter().map(|own| circle::centre_name(*own, &self.notation)).collect();
                let mut ink = Group::new("centre").data("centre", names.join(" "));
                ink.mark(dot(Point::ORIGIN, 0.6).class("centre"));
                let radius = if pin.is_some() { skeleton::PIN + 0.2 } else { 1.3 };
                LayerPoint { at, name: Some(self.name_of_centres(&links, radius)), ink }
            })
            .collect()
    }

    fn auxiliary(&self, drawing: &crate::graphical::auxiliary::AuxiliaryDrawing) -> Layer {
        let strokes = drawing.strokes.iter().filter_map(|stroke| {
            let pen = match stroke.role {
                StrokeRole::Construction | StrokeRole::Produced => Pen::solid(FINE),
                StrokeRole::Image | StrokeRole::Result => Pen::solid(auxiliary::RESULT),
                StrokeRole::Axis => Pen::chain(FINE),
                StrokeRole::Other => Pen::dashed(THIN),
                StrokeRole::Counterpart => Pen::dashed(auxiliary::RESULT),
                StrokeRole::Vector => Pen::solid(THICK),
            };
            let (way, at) = match &stroke.shape {
                StrokeShape::Line(from, to) => {
                    let way = match stroke.role {
                        StrokeRole::Vector => Way::Arrow,
                        StrokeRole::Produced | StrokeRole::Axis => Way::Through,
                        _ => Way::Line,
                    };
                    (way, vec![Some(page(*from)), Some(page(*to))])
                }
                StrokeShape::Circle { centre, radius } => (Way::Circle(*radius), vec![Some(page(*centre))]),
                StrokeShape::Curve { .. } | StrokeShape::RightAngle { .. } => return None,
            };
            Some(LayerStroke { way, at, pen, class: "construction", of: String::new() })
        });
        let points = drawing.points.iter().map(|point| {
            let text = auxiliary::name(point.name, &self.notation);
            let site = Site::Around { at: Point::ORIGIN, radius: 0.9, toward: None };
            let name = Name { request: Request::new(text, super::ink::LABEL, site, "label auxiliary-name") };
            let mut ink = Group::new("point");
            let circle = Shape::Circle { centre: Point::ORIGIN, radius: 0.7 };
            ink.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Ink).class("point"));
            LayerPoint { at: Some(page(point.at)), name: Some(name), ink }
        });
        let names = auxiliary::vectors_between(drawing).map(|(quantity, from, to)| {
            let (at, site) = ([Some(from), Some(to)], Site::Along { from, to });
            let text = self.notation.symbol(quantity, false);
            let request = Request::new(text, SMALL, site, "label vector-name");
            let request = request.naming(vec![self.notation.quantity_name(quantity)]);
            LayerName { at, name: Name { request } }
        });
        let scales = auxiliary::scales(drawing).into_iter().map(|(dimension, si_per_mm)| LayerScale {
            dimension,
            si_per_mm,
            follows: true,
        });
        Layer {
            figure: drawing.kind.figure(),
            title: auxiliary::title(&drawing.kind, &self.notation).html(),
            strokes: strokes.collect(),
            points: points.collect(),
            names: names.collect(),
            scales: scales.collect(),
        }
    }

    /// The name of images that are always one point.
    #[must_use]
    pub fn name_of_images(&self, kind: DiagramKind, labels: &[Label]) -> Option<Name> {
        let polygon = self.construction.diagram(kind)?;
        Some(Name { request: polygon::name_of_images(labels, polygon, &self.notation) })
    }

    /// The name of vectors that are always one stroke, by their places in the polygon.
    #[must_use]
    pub fn name_of_vectors(&self, kind: DiagramKind, vectors: &[usize]) -> Option<Name> {
        let polygon = self.construction.diagram(kind)?;
        let vectors: Vec<&Vector> = vectors.iter().filter_map(|index| polygon.vectors.get(*index)).collect();
        Some(Name { request: polygon::name_of_vectors(&vectors, polygon, &self.notation) })
    }

    /// What a diagram is called.
    #[must_use]
    pub fn title(&self, kind: DiagramKind) -> String {
        panels::title(kind, self.notation.words).to_owned()
    }

    /// A quantity's symbol as hypertext.
    #[must_use]
    pub fn symbol(&self, quantity: Quantity) -> String {
        self.notation.symbol(quantity, false).html()
    }

    /// A scale as hypertext.
    #[must_use]
    pub fn scale(&self, dimension: Dimension, si_per_mm: f64) -> String {
        let scale = match dimension {
            Dimension::Length => self.notation.length_scale(si_per_mm),
            dimension => self.notation.scale(si_per_mm, dimension),
        };
        Rich::fill(self.notation.words.scale, &[("scale", scale)]).html()
    }

    /// The scale of a skeleton with those of what is drawn over it, as hypertext.
    #[must_use]
    pub fn scales(&self, metres_per_mm: f64, over: &[LayerScale]) -> String {
        let words = self.notation.words;
        let one = |scale: &LayerScale| match scale.follows {
            true => auxiliary::scale_that_follows(scale.si_per_mm, scale.dimension, &self.notation),
            false => self.notation.scale(scale.si_per_mm, scale.dimension),
        };
        let skeleton = self.notation.length_scale(metres_per_mm);
        let all = over.iter().fold(skeleton, |all, scale| all.aside(words.comma, &one(scale)));
        // It breaks after a comma, and in no number.
        Rich::fill(words.scale, &[("scale", all)]).html().replace('\u{2009}', "\u{202f}")
    }

    /// The scene's unit of what lengths of a diagram stand for.
    #[must_use]
    pub fn unit(&self, dimension: Dimension) -> Unit {
        self.notation.unit(dimension)
    }

    /// How quantities of this order are called in the data of the ink.
    #[must_use]
    pub fn quantity_name(&self, quantity: Quantity) -> String {
        self.notation.quantity_name(quantity)
    }

    /// The words for a rotation: counterclockwise, clockwise.
    #[must_use]
    pub fn senses(&self) -> [String; 2] {
        [self.notation.sense(1.0).to_owned(), self.notation.sense(-1.0).to_owned()]
    }

    /// Words of the steps that hold at the instant that was drawn, whatever numbers stand beside them.
    #[must_use]
    pub fn of_an_instant(&self) -> Vec<String> {
        let words = self.notation.words;
        let vectors = self.construction.diagrams.iter().flat_map(|diagram| &diagram.vectors);
        let velocities = vectors.flat_map(|vector| match vector.quantity {
            Quantity::Acceleration(p) => vec![Quantity::Velocity(p)],
            Quantity::SlipAcceleration(p, link) => vec![Quantity::Slip(p, link)],
            _ => Vec::new(),
        });
        let mut all: Vec<String> = velocities
            .flat_map(|velocity| {
                let rotation = self.notation.symbol(velocity, false);
                [words.in_sense_of, words.against_sense_of]
                    .map(|template| Rich::fill(template, &[("rotation", rotation.clone())]).html())
            })
            .collect();
        // A normal part leads to its centre wherever that is; the way along a line changes with the sense of what lies in it.
        let vectors = self.construction.diagrams.iter().flat_map(|diagram| &diagram.vectors);
        for vector in vectors.filter(|vector| vector.kind != VectorKind::Normal) {
            if let Some(Claim::Parallel(Reference::Points(p, q))) = vector.claim {
                let [p, q] = [p, q].map(|point| self.notation.point(point));
                all.extend([(&p, &q), (&q, &p)].map(|(p, q)| p.clone().up(WAY).then(q).html()));
            }
        }
        all
    }

    /// Vectors by the symbols that stand for them in the tables of terms.
    #[must_use]
    pub fn terms(&self) -> Vec<(String, String)> {
        let vectors = self.construction.diagrams.iter().flat_map(|diagram| &diagram.vectors);
        let both = |q: Quantity| (self.notation.symbol(q, true).html(), self.notation.quantity_name(q));
        let mut all: Vec<(String, String)> = Vec::new();
        for pair in vectors.map(|vector| both(vector.quantity)) {
            if !all.iter().any(|(symbol, _)| *symbol == pair.0) {
                all.push(pair);
            }
        }
        all
    }

    /// The steps in words.
    #[must_use]
    pub fn said(&self, lengths: Lengths) -> Vec<Said> {
        let construction = taken(&self.construction, lengths);
        let told = steps::by_step(&construction, &self.notation);
        let told = told.into_iter().filter(|told| matches!(told.drawn, None | Some(Panel::Diagram(_))));
        told.map(|told| {
            let mut said =
                Said { step: told.step, head: String::new(), equations: Vec::new(), sentences: Vec::new() };
            let acts = construction.steps.get(told.step).map_or(&[][..], |step| &step.acts);
            for (item, act) in told.items.into_iter().zip(told.acts) {
                match item {
                    Item::Head(text) if said.head.is_empty() => said.head = text.html(),
                    Item::Head(text) => said.head = format!("{} · {}", said.head, text.html()),
                    Item::Terms(table) => {
                        let row = |cells: &[Rich]| cells.iter().map(ticked).collect();
                        let mut rows = vec![row(&table.head)];
                        rows.extend(table.rows.iter().map(|cells| row(cells)));
                        said.equations.push(rows);
                    }
                    Item::Sentence(text) => {
                        let told = act.and_then(|index| acts.get(index));
                        let is_of_length =
                            matches!(told, Some(Act::LayOffVector { .. } | Act::ReadVector { .. }));
                        said.sentences.push(Sentence { text: text.html(), act, is_of_length });
                    }
                }
            }
            said
        })
        .collect()
    }
}

/// Where a centre is on the page; nothing where it is at infinity.
fn on_paper(circle: &CircleDiagram, links: [LinkId; 2]) -> Option<Point> {
    match circle.centre(links).map(|centre| centre.place) {
        Some(CentrePlace::At(at)) => Some(page(at)),
        _ => None,
    }
}

/// A number as the steps print it, with so many figures more, as hypertext.
#[must_use]
pub fn printed(value: f64, more: usize) -> String {
    human::finer(value, more).0.html()
}

/// A stated number, as hypertext.
#[must_use]
pub fn printed_stated(value: f64) -> String {
    human::stated(value).html()
}

/// Millimetres of paper without their unit.
#[must_use]
pub fn printed_mm(value: f64, decimals: usize) -> String {
    human::fixed(value, decimals)
}

/// An angle in degrees.
#[must_use]
pub fn printed_degrees(radians: f64) -> String {
    human::degrees(radians).html()
}

/// A cell as hypertext, with its tick as a letter.
fn ticked(cell: &Rich) -> String {
    if *cell == Rich::tick() { "✓".to_owned() } else { cell.html() }
}

/// A unit as it is printed.
#[must_use]
pub fn unit(symbol: &str) -> String {
    human::pretty(symbol)
}

/// One position of a course, as the placement of names sees it.
#[derive(Debug)]
pub struct Frame {
    /// The ink.
    pub ink: Group,
    /// What each name stands by; `None` where there is no name now.
    pub spots: Vec<Option<Spot>>,
}

/// A change of place by a millimetre costs so much, and by more its square.
const CHANGE: f64 = 1.2;
/// So far from the middle of a stroke a name may stand, mm: from farther off it would glide for half of the course.
const MOST_ASIDE: f64 = 12.0;
/// What disturbs at the position at which a page opens counts so many times.
const AT_HOME: f64 = 6.0;
/// A change of place that goes far costs so much, and by each millimetre so much more: as long as it glides a name may stand in
/// others' way.
const FAR_CHANGE: (f64, f64) = (50.0, 6.0);
/// A name that would be taken for that of another point costs so much; points nearer to each other than this are one, mm.
const ASTRAY: f64 = 60.0;
const SAME: f64 = 0.5;
/// The number of a link may be nearer to another link than to its own by so much, mm: where these meet it is both's.
const BESIDE: f64 = 0.3;
/// A name that stands farther than this from what it names is tied to it by a fine line, mm.
const TIED: f64 = 2.6;
/// The line that ties a name ends on this part of its stroke, about the middle: at its ends others begin.
const TIED_WITHIN: f64 = 0.8;
/// A name that does not stand wholly on the panel costs so much.
const BEYOND: f64 = 350.0;
/// A name in the way of another's line costs so much, two lines that cross, and every millimetre of a line.
const IN_A_TIE: f64 = 90.0;
const TIES_CROSS: f64 = 30.0;
const TIE: f64 = 0.4;
/// Each name is placed anew so often, given the others.
const PASSES: usize = 3;

/// Clear space between names.
const CLEAR: f64 = 0.8;

/// A course along which names are placed.
#[derive(Debug, Clone, Copy)]
pub struct Course {
    /// The last frame comes before the first.
    pub cyclic: bool,
    /// A name goes no further from frame to frame along either axis, mm.
    pub glide: f64,
    /// The frame at which a page opens: there names stand where they are best, and at rest.
    pub home: usize,
    /// A name that finds no room beside what it names may stand farther off, tied to it by a line.
    pub ties: bool,
    /// What is shown of the plane: names stand in it.
    pub shown: Rect,
}

/// Where a name may stand in one frame.
#[derive(Debug, Clone, Copy)]
struct Priced {
    /// From its anchor.
    by: Vec2,
    /// What it costs beside the ink.
    cost: f64,
    /// The line that ties it, from its anchor.
    tie: Option<(Vec2, Vec2)>,
}

/// The line by which a name is tied to what it names, both ends told from its anchor: from the edge of its box, which stands
/// `by` from the anchor, to the nearest place of the stroke that lies off its ends. None where it stands beside it.
#[must_use]
fn tie(spot: Spot, half: Vec2, by: Vec2) -> Option<(Vec2, Vec2)> {
    let end = match spot {
        Spot::Point(_) => Vec2::ZERO,
        Spot::Stroke(from, to) => {
            let d = to - from;
            let part = if d.hypot2() > 0.0 { by.dot(d) / d.hypot2() } else { 0.0 };
            d * part.clamp(-TIED_WITHIN / 2.0, TIED_WITHIN / 2.0)
        }
    };
    let way = end - by;
    // The part of the way that lies in the box.
    let inside = (half.x / way.x.abs()).min(half.y / way.y.abs());
    ((1.0 - inside) * way.hypot() >= TIED).then(|| (by + way * inside, end))
}

/// Where names stand along a course: for each name and frame how far its middle is from its anchor. Each name takes the
/// sequence of places that costs least over the course, a change of place among the costs; name after name, given the
/// others.
#[must_use]
pub fn along(names: &[Name], frames: &[Frame], course: Course) -> Vec<Vec<Vec2>> {
    let Course { cyclic, glide, home, ties, shown } = course;
    let ink: Vec<Obstacles> = frames.iter().map(|frame| Obstacles::of(&frame.ink)).collect();
    let halves: Vec<Vec2> = names.iter().map(Name::half).collect();
    // The ink does not change from pass to pass.
    let priced: Vec<Vec<Vec<Priced>>> = names
        .iter()
        .zip(&halves)
        .enumerate()
        .map(|(n, (name, half))| {
            let at = |(frame, ink): (&Frame, &Obstacles)| {
                let spot = frame.spots[n]?;
                let anchor = spot.anchor();
                let places = places(name, *half, spot, ties).into_iter();
                let price = |(by, taste): (Vec2, f64)| {
                    let own = Rect::from_center_size(anchor + by, (2.0 * half.x, 2.0 * half.y));
                    let tie = if ties { tie(spot, *half, by) } else { None };
                    let long = tie.map_or(0.0, |(from, to)| TIE * (to - from).hypot());
                    let off = if shown.contains_rect(own) { 0.0 } else { BEYOND };
                    Priced { by, cost: taste + long + off + ink.cost_up_to(own, 400.0).min(400.0), tie }
                };
                Some(places.map(price).collect::<Vec<_>>())
            };
            frames.iter().zip(&ink).map(|pair| at(pair).unwrap_or_default()).collect()
        })
        .collect();
    // The name of a point that stands nearer to another point that has a name would be taken for the other's.
    // So would the number of a link that stands nearer to another one.
    let is_number = |n: usize| names[n].request.ring.is_some();
    let of_another_link = |n: usize, frame: usize, at: Point| {
        let off = |n: usize| match frames[frame].spots[n] {
            Some(Spot::Stroke(from, to)) if is_number(n) => {
                Some(Line::new(from, to).nearest(at, 1e-6).distance_sq.sqrt())
            }
            _ => None,
        };
        let nearer =
            |own: f64| (0..names.len()).filter(|m| *m != n).filter_map(off).any(|other| other < own - BESIDE);
        if off(n).is_some_and(nearer) { ASTRAY } else { 0.0 }
    };
    let astray = |n: usize, frame: usize, at: Point| {
        let spots = &frames[frame].spots;
        let Some(Some(Spot::Point(own))) = spots.get(n) else { return of_another_link(n, frame, at) };
        let off = |point: Point| {
            let way = point - at;
            libm::hypot((way.x.abs() - halves[n].x).max(0.0), (way.y.abs() - halves[n].y).max(0.0))
        };
        let nearer = |spot: &Spot| matches!(spot, Spot::Point(other) if other.distance(*own) > SAME && off(*other) < off(*own));
        if spots.iter().flatten().any(nearer) { ASTRAY } else { 0.0 }
    };
    let mut chosen: Vec<Vec<Option<usize>>> = vec![vec![None; frames.len()]; names.len()];
    for _ in 0..PASSES {
        for n in 0..names.len() {
            // The others as they stand: their middles, halves and lines.
            let others: Vec<Vec<Standing>> = (0..frames.len())
                .map(|frame| {
                    let standing = |m: usize| {
                        let place = priced[m][frame][chosen[m][frame]?];
                        let anchor = frames[frame].spots[m]?.anchor();
                        Some(Standing::new(place, anchor, halves[m]))
                    };
                    (0..names.len()).filter(|m| *m != n).filter_map(standing).collect()
                })
                .collect();
            let cost = |frame: usize, place: usize| {
                let place = priced[n][frame][place];
                let Some(anchor) = frames[frame].spots[n].map(Spot::anchor) else { return place.cost };
                let own = Standing::new(place, anchor, halves[n]);
                let others: f64 = others[frame].iter().map(|other| own.beside(other)).sum();
                let astray = if own.tie.is_some() { 0.0 } else { astray(n, frame, own.at) };
                (place.cost + others + astray) * if frame == home { AT_HOME } else { 1.0 }
            };
            chosen[n] = least(&priced[n], cost, cyclic);
        }
    }
    let mut ways: Vec<Vec<Vec2>> = chosen
        .iter()
        .enumerate()
        .map(|(n, chosen)| gliding(&priced[n], chosen, cyclic, glide, home))
        .collect();
    if ties {
        give_way(&mut ways, &halves, (frames, &ink), course);
    }
    ways
}

/// Where a name that glides would pass through another, or along a stroke, it goes round that, as fast as it may glide: the cheapest
/// way near its own, told by steps of a grid off it, and back on its own soon after.
fn give_way(
    ways: &mut [Vec<Vec2>],
    halves: &[Vec2],
    (frames, ink): (&[Frame], &[Obstacles]),
    course: Course,
) {
    /// A name goes no further off its way than so many steps.
    const STEPS: i32 = 5;
    /// It leaves its way so many frames before it would meet another, and is back so many after.
    const AROUND: usize = 8;
    /// What a step and a millimetre off its way cost.
    const STEP: f64 = 1.5;
    const OFF: f64 = 0.6;
    /// To be struck through for a while is better than to be left out.
    const STRUCK: f64 = 120.0;
    /// Each name gives way so often.
    const ROUNDS: usize = 2;
    /// Of what is counted in floating-point numbers.
    const EXACT: f64 = 1e-9;
    let Course { cyclic, glide, home, shown, .. } = course;
    let (count, side) = (frames.len(), 2 * STEPS + 1);
    if count < 2 || glide <= 0.0 {
        return;
    }
    let standing = |n: usize, frame: usize, by: Vec2| {
        let spot = frames[frame].spots[n]?;
        Some(Standing::new(Priced { by, cost: 0.0, tie: tie(spot, halves[n], by) }, spot.anchor(), halves[n]))
    };
    let on_its_way = side * side / 2;
    let offset = |k: i32| [k % side - STEPS, k / side - STEPS];
    let off = |k: i32| {
        let [i, j] = offset(k);
        Vec2::new(f64::from(i), f64::from(j)) * glide
    };
    let states = usize::try_from(side * side).unwrap_or(0);
    // From home round to home, or from end to end.
    let order: Vec<usize> =
        if cyclic { (0..=count).map(|i| (home + i) % count).collect() } else { (0..count).collect() };
    for n in (0..ROUNDS).flat_map(|_| (0..halves.len()).rev()) {
        let others: Vec<Vec<Standing>> = (0..count)
            .map(|f| {
                (0..halves.len()).filter(|m| *m != n).filter_map(|m| standing(m, f, ways[m][f])).collect()
            })
            .collect();
        let struck = |f: usize, own: &Standing| {
            let space = Rect::from_center_size(own.at, (2.0 * own.half.x, 2.0 * own.half.y));
            ink[f].cost_up_to(space, STRUCK).min(STRUCK)
        };
        let meets = |f: usize| {
            let own = standing(n, f, ways[n][f]);
            own.is_some_and(|own| others[f].iter().any(|other| own.meets(other)) || struck(f, &own) >= STRUCK)
        };
        let met: Vec<usize> = (0..count).filter(|f| meets(*f)).collect();
        if met.is_empty() {
            continue;
        }
        let is_near = |f: usize, g: usize| frames_apart(f, g, count, cyclic) <= AROUND as f64;
        let may_leave: Vec<bool> =
            (0..count).map(|f| f != home && met.iter().any(|g| is_near(f, *g))).collect();
        let price = |f: usize, by: Vec2| {
            let Some(own) = standing(n, f, by) else { return 0.0 };
            let space = Rect::from_center_size(own.at, (2.0 * own.half.x, 2.0 * own.half.y));
            let struck = struck(f, &own);
            let beyond = if shown.contains_rect(space) { 0.0 } else { BEYOND };
            let long = own.tie.map_or(0.0, |(from, to)| TIE * from.distance(to));
            others[f].iter().map(|other| own.beside(other)).sum::<f64>() + struck + beyond + long
        };
        let mut sums: Vec<f64> = Vec::new();
        let mut back: Vec<Vec<i32>> = Vec::with_capacity(order.len());
        for (i, &f) in order.iter().enumerate() {
            let mut next = vec![f64::INFINITY; states];
            let mut from = vec![on_its_way; states];
            let way = if i > 0 { ways[n][f] - ways[n][order[i - 1]] } else { Vec2::ZERO };
            for (k, index) in (0..side * side).zip(0..states) {
                if !may_leave[f] && k != on_its_way {
                    continue;
                }
                let [a, b] = offset(k);
                let mut best = if i == 0 && k == on_its_way { 0.0 } else { f64::INFINITY };
                for (x, y) in (-1..=1).flat_map(|x| (-1..=1).map(move |y| (x, y))).filter(|_| i > 0) {
                    let (u, v) = (a - x + STEPS, b - y + STEPS);
                    let goes = way + Vec2::new(f64::from(x), f64::from(y)) * glide;
                    if (0..side).contains(&u)
                        && (0..side).contains(&v)
                        && goes.x.abs().max(goes.y.abs()) <= glide + EXACT
                        && let Some(sum) =
                            usize::try_from(v * side + u).ok().and_then(|other| sums.get(other))
                    {
                        let sum = sum + STEP * f64::from(x.abs() + y.abs());
                        if sum < best {
                            (best, from[index]) = (sum, v * side + u);
                        }
                    }
                }
                if best.is_finite() {
                    let by = off(k);
                    let own = if may_leave[f] { price(f, ways[n][f] + by) } else { 0.0 };
                    next[index] = best + own + OFF * by.hypot();
                }
            }
            sums = next;
            back.push(from);
        }
        let least = (0..side * side).zip(&sums).min_by(|a, b| a.1.total_cmp(b.1));
        let Some((mut k, _)) = least.filter(|(_, sum)| sum.is_finite()) else { continue };
        for (i, &f) in order.iter().enumerate().rev() {
            // Round a course the first frame is the last one, on its way.
            if i > 0 || !cyclic {
                ways[n][f] += off(k);
            }
            k = usize::try_from(k).ok().and_then(|k| back[i].get(k)).copied().unwrap_or(on_its_way);
        }
    }
}

/// A name in its place.
#[derive(Debug, Clone, Copy)]
struct Standing {
    at: Point,
    half: Vec2,
    tie: Option<(Point, Point)>,
    /// What it costs nothing to stay out of.
    reach: Rect,
}

impl Standing {
    fn new(place: Priced, anchor: Point, half: Vec2) -> Self {
        let tie = place.tie.map(|(from, to)| (anchor + from, anchor + to));
        let at = anchor + place.by;
        let own = Rect::from_center_size(at, (2.0 * half.x, 2.0 * half.y)).inflate(CLEAR, CLEAR);
        let reach = tie.map_or(own, |(from, to)| own.union_pt(from).union_pt(to));
        Self { at, half, tie, reach }
    }

    /// Whether one name stands in the other, or in the way of its line.
    fn meets(&self, other: &Self) -> bool {
        self.beside(other) >= IN_A_TIE
    }

    /// What two names cost each other.
    fn beside(&self, other: &Self) -> f64 {
        if !self.reach.overlaps(other.reach) {
            return 0.0;
        }
        let mut cost = beside(self.at - other.at, self.half + other.half);
        let across = |tie: Option<(Point, Point)>, own: &Self| {
            let hit = |(from, to)| {
                let own = Rect::from_center_size(own.at, (2.0 * own.half.x, 2.0 * own.half.y));
                clip(from, to, own.inflate(0.3, 0.3)).is_some()
            };
            if tie.is_some_and(hit) { IN_A_TIE } else { 0.0 }
        };
        cost += across(self.tie, other) + across(other.tie, self);
        if let (Some((a, b)), Some((c, d))) = (self.tie, other.tie)
            && crossing(a, b, c, d)
        {
            cost += TIES_CROSS;
        }
        cost
    }
}

/// The way of a name through its places: before and after a change it glides, along either axis by no more than `glide`
/// from frame to frame. Where there is no name it stays, or is on its way to where it comes back. In the frame `home` it is not
/// on its way: it leaves its place there late enough, and is back early enough.
fn gliding(
    priced: &[Vec<Priced>],
    chosen: &[Option<usize>],
    cyclic: bool,
    glide: f64,
    home: usize,
) -> Vec<Vec2> {
    let mut last = Vec2::ZERO;
    let mut places: Vec<Vec2> = chosen
        .iter()
        .zip(priced)
        .map(|(place, places)| {
            last = place.and_then(|place| places.get(place)).map_or(last, |place| place.by);
            last
        })
        .collect();
    if let Some(at_home) = places.get(home).copied() {
        let count = places.len();
        for (frame, place) in places.iter_mut().enumerate() {
            let reach = glide * frames_apart(frame, home, count, cyclic);
            place.x = place.x.clamp(at_home.x - reach, at_home.x + reach);
            place.y = place.y.clamp(at_home.y - reach, at_home.y + reach);
        }
    }
    // A single change becomes a slope of half the bound; what is faster after that is slowed down once more.
    slowed(&slowed(&places, cyclic, 2.0 * glide), cyclic, glide)
}

/// How many frames lie between two, the shorter way round a cyclic course.
fn frames_apart(one: usize, other: usize, count: usize, cyclic: bool) -> f64 {
    let frames = one.abs_diff(other);
    (if cyclic { frames.min(count - frames) } else { frames }) as f64
}

/// Halfway between the lowest and the highest of the ways that go no further than `most` from frame to frame and meet `way`.
fn slowed(way: &[Vec2], cyclic: bool, most: f64) -> Vec<Vec2> {
    let count = way.len();
    let apart = |f: usize, g: usize| frames_apart(f, g, count, cyclic);
    let axis = |f: usize, of: fn(Vec2) -> f64| {
        let low = (0..count).map(|g| of(way[g]) + most * apart(f, g)).fold(f64::INFINITY, f64::min);
        let high = (0..count).map(|g| of(way[g]) - most * apart(f, g)).fold(f64::NEG_INFINITY, f64::max);
        f64::midpoint(low, high)
    };
    (0..count).map(|f| Vec2::new(axis(f, |by| by.x), axis(f, |by| by.y))).collect()
}

/// What two boxes cost each other, by the way between their middles and the sum of their halves.
fn beside(way: Vec2, halves: Vec2) -> f64 {
    let (x, y) = (halves.x - way.x.abs(), halves.y - way.y.abs());
    if x > 0.0 && y > 0.0 {
        300.0 + 100.0 * x.min(y)
    } else if x > -CLEAR && y > -CLEAR {
        15.0
    } else {
        0.0
    }
}

/// Where a name may stand, from its anchor, with what that costs as a matter of taste. The order is the same in every
/// frame of a name.
fn places(name: &Name, half: Vec2, spot: Spot, ties: bool) -> Vec<(Vec2, f64)> {
    const WAYS: u32 = 16;
    /// Rings about the middle in which a name is tied, mm; so many ways, and dearer by so much than beside it.
    const FAR: ([f64; 3], u32, f64) = ([6.5, 11.0, 17.5], 12, 10.0);
    let around_by = |ways: u32, radius: f64, gaps: &[f64], dear: f64| {
        let mut all = Vec::new();
        for (ring, gap) in gaps.iter().enumerate() {
            for k in 0..ways {
                let (sin, cos) = libm::sincos(f64::from(k) * (std::f64::consts::TAU / f64::from(ways)));
                let side = |half: f64, c: f64| half * (c * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
                let reach = radius + gap;
                let by = Vec2::new(reach * cos + side(half.x, cos), -reach * sin - side(half.y, sin));
                all.push((by, dear + 3.0 * ring as f64 + 0.6 * (1.0 - libm::cos(f64::from(k) - 2.0))));
            }
        }
        all
    };
    let around = |radius: f64, gaps: &[f64], dear: f64| around_by(WAYS, radius, gaps, dear);
    let far = if ties { around_by(FAR.1, 0.5, &FAR.0, FAR.2) } else { Vec::new() };
    let mut all = match spot {
        Spot::Point(_) if ties => around(name.radius(), &[0.7, 1.8], 0.0),
        Spot::Point(_) => around(name.radius(), &[0.7, 1.8, 3.4], 0.0),
        Spot::Stroke(from, to) => {
            let d = to - from;
            let length = d.hypot();
            // A stroke of no length has its name as if it lay.
            let along = if length < 1e-6 { Vec2::new(1.0, 0.0) } else { d / length };
            let normal = Vec2::new(along.y, -along.x);
            let reach = (normal.x * half.x).abs() + (normal.y * half.y).abs();
            let reach = if name.request.ring.is_some() { half.x } else { reach };
            let mut all = Vec::new();
            for (i, t) in [0.0, -0.12, 0.12, -0.25, 0.25, -0.38, 0.38].into_iter().enumerate() {
                for side in [1.0, -1.0] {
                    for (ring, gap) in [0.9, 2.4].into_iter().enumerate() {
                        let aside = (t * length).clamp(-MOST_ASIDE, MOST_ASIDE);
                        let by = along * aside + normal * (side * (reach + gap));
                        all.push((by, 0.8 * i as f64 + 3.0 * ring as f64));
                    }
                }
            }
            // Where the stroke is short or crowded.
            all.extend(around(0.5, if ties { &[3.0] } else { &[3.0, 5.5] }, 8.0));
            all
        }
    };
    all.extend(far);
    all
}

/// The sequence of places that costs least, by dynamic programming; a cyclic one begins where it ends.
fn least(priced: &[Vec<Priced>], cost: impl Fn(usize, usize) -> f64, cyclic: bool) -> Vec<Option<usize>> {
    // Frames in which there is no such name part the course.
    let mut chosen: Vec<Option<usize>> = vec![None; priced.len()];
    let whole = priced.iter().all(|places| !places.is_empty());
    let mut from = 0;
    while from < priced.len() {
        if priced[from].is_empty() {
            from += 1;
            continue;
        }
        let to = (from..priced.len()).find(|f| priced[*f].is_empty()).unwrap_or(priced.len());
        let first = sequence(priced, from..to, &cost, None);
        let run = match (cyclic && whole, first.len()) {
            // Once more round: from where the middle of the course stands.
            (true, length) if length > 2 => {
                let half = length / 2;
                let turned: Vec<usize> = (0..=length).map(|i| (i + half) % length).collect();
                let held = first[half];
                let round = path(priced, &turned, &cost, Some((held, held)));
                let mut run = vec![0; length];
                for (frame, place) in turned.iter().zip(&round).take(length) {
                    run[*frame] = *place;
                }
                run
            }
            _ => first,
        };
        for (frame, place) in (from..to).zip(run) {
            chosen[frame] = Some(place);
        }
        from = to;
    }
    chosen
}

fn sequence(
    priced: &[Vec<Priced>],
    frames: std::ops::Range<usize>,
    cost: &impl Fn(usize, usize) -> f64,
    held: Option<(usize, usize)>,
) -> Vec<usize> {
    path(priced, &frames.collect::<Vec<_>>(), cost, held)
}

/// The cheapest way through these frames; `held`: the places in the first and in the last of them.
fn path(
    priced: &[Vec<Priced>],
    frames: &[usize],
    cost: &impl Fn(usize, usize) -> f64,
    held: Option<(usize, usize)>,
) -> Vec<usize> {
    let mut sums: Vec<f64> = Vec::new();
    let mut back: Vec<Vec<usize>> = Vec::with_capacity(frames.len());
    for (i, &frame) in frames.iter().enumerate() {
        let places = &priced[frame];
        let own: Vec<f64> = (0..places.len()).map(|place| cost(frame, place)).collect();
        if i == 0 {
            sums = own;
            if let Some((first, _)) = held {
                sums.iter_mut()
                    .enumerate()
                    .filter(|(p, _)| *p != first)
                    .for_each(|(_, sum)| *sum = f64::INFINITY);
            }
            back.push(vec![0; places.len()]);
            continue;
        }
        let before = &priced[frames[i - 1]];
        let mut cheapest_first: Vec<usize> = (0..sums.len()).collect();
        cheapest_first.sort_by(|a, b| sums[*a].total_cmp(&sums[*b]));
        let (mut next, mut from) = (Vec::with_capacity(places.len()), Vec::with_capacity(places.len()));
        for (place, Priced { by, .. }) in places.iter().enumerate() {
            // Of one place in two frames only the ink has moved: no change.
            let mut best = (place, sums.get(place).copied().unwrap_or(f64::INFINITY));
            for &other in &cheapest_first {
                if sums[other] >= best.1 {
                    break;
                }
                let far = (*by - before[other].by).hypot2();
                let change = (CHANGE * far).min(FAR_CHANGE.0 + FAR_CHANGE.1 * far.sqrt());
                if sums[other] + change < best.1 {
                    best = (other, sums[other] + change);
                }
            }
            next.push(best.1 + own[place]);
            from.push(best.0);
        }
        sums = next;
        back.push(from);
    }
    let cheapest = sums.iter().enumerate().min_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(place, _)| place);
    let mut at = held.map_or(cheapest, |(_, last)| last);
    let mut run = vec![0; frames.len()];
    for i in (0..frames.len()).rev() {
        run[i] = at;
        at = back[i].get(at).copied().unwrap_or(0);
    }
    run
}
