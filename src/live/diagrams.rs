//! The diagrams of a page: what of their ink hangs on which numbers, at which scale, and where names stand along the course.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;

use kurbo::{Point, Rect, Vec2};
use serde_json::{Value, json};

use super::LiveError;
use super::moves::{Binder, Frame, Move, Moving, PAST, Place, Seen, bind, marks, shape_through};
use super::said::{Paper, Printed, TAKEN};
use crate::graphical::Scales;
use crate::graphical::construction::{Construction, ConstructionLine, Diagram, Image, Label};
use crate::mechanism::quantity::{DiagramKind, Dimension, Order, Quantity, Unit};
use crate::mechanism::{Input, LinkId, Mechanism, Place as MechanismPlace, PointId, Rider};
use crate::plan::Extent;
use crate::scene::Scene;
use crate::sheet::figure::{Group, Mark, Node, Shape};
use crate::sheet::moving::{
    self, Draughts, Drawing, Layer, LayerScale, Lengths, Name, Opening, Said, Spot, Way, arrow,
};
use crate::sheet::{Language, scale};
use crate::solve::{Settings, solve_with};
use crate::sweep::{Column, InputKind, Sweep};

/// At so many positions ink is drawn to find out how it moves.
const DRAWN: usize = 5;
/// At so many places of the course names are placed.
const FRAMES: u32 = 180;
/// A skeleton over its whole course fits into this, mm.
const SKELETON: (f64, f64) = (150.0, 115.0);
/// The same of a polygon.
const POLYGON: (f64, f64) = (110.0, 100.0);
/// Blank around what moves, for names and symbols, mm.
const BORDER: f64 = 13.0;
/// Of equally spaced positions so many of a hundred count for the scale of a polygon.
const COUNTED: usize = 95;
/// Room about the tip of an arrow, mm.
const ROOM: f64 = 5.0;
/// A panel grows to this for what a layer adds to its skeleton, mm.
const LARGEST: (f64, f64) = (160.0, 150.0);
/// A polygon that could be so many times larger is too small to be read.
const SMALLEST_PART: f64 = 4.0;
/// A vector that is shorter is a dot and has no name now, mm.
const SHORTEST_NAMED: f64 = 1.0;

/// What a panel shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Shows {
    /// The skeleton, a polygon.
    Diagram,
    /// The skeleton under a layer, by index.
    Layer(usize),
    /// The circle diagram, which does not change.
    Circle,
}

/// A diagram of a page.
#[derive(Debug)]
pub(super) struct Panel {
    pub(super) kind: DiagramKind,
    pub(super) shows: Shows,
    pub(super) title: String,
    pub(super) scale_text: String,
    /// Its ink at the scene's own position, every moving group with an identifier.
    pub(super) ink: Group,
    /// The part of its plane that is shown, mm.
    pub(super) shown: Rect,
    pub(super) si_per_mm: f64,
    /// The scales of what is drawn over a skeleton, where they are the same in every position.
    pub(super) over: Vec<LayerScale>,
    /// The scene's unit of what its lengths stand for.
    unit: Unit,
    origin: [f64; 2],
    places: Vec<Place>,
    /// So many of the places are those of the diagram itself.
    own_places: usize,
    moving: Vec<Moving>,
    names: Vec<Placed>,
    /// Pins that leave their slots.
    openings: Vec<Leaving>,
}

/// A pin that leaves its slot: by place the pin and the pivot of the slot, how far apart they are as long as it is there, mm, and
/// the names of the pin and of the link.
#[derive(Debug)]
struct Leaving {
    ends: [usize; 2],
    reach: f64,
    names: [String; 2],
}

/// A name along the course.
#[derive(Debug)]
struct Placed {
    id: String,
    anchors: Anchors,
    by: Vec<Vec2>,
    /// Half its width and height.
    half: Vec2,
    step: Option<usize>,
    /// It stands while the output of this index is known and not zero.
    output: Option<usize>,
    of: Vec<String>,
    /// It names a point, not a link or a stroke.
    is_of_point: bool,
    /// It names an arrow on a skeleton.
    is_of_arrow: bool,
}

/// The diagrams of a page.
#[derive(Debug)]
pub(super) struct Diagrams {
    pub(super) panels: Vec<Panel>,
    drawn: Drawn,
    /// The page opens with polygons that are fitted to each position; names are placed for that.
    pub(super) refit: bool,
}

/// Numbers of one position, by column.
type Numbers = Vec<Option<f64>>;

fn column(sweep: &Sweep, quantity: Quantity) -> Option<usize> {
    sweep.columns.iter().position(|c| c.asked.quantity == quantity && c.axis == Some(0))
}

fn scalar(sweep: &Sweep, quantity: Quantity) -> Option<usize> {
    sweep.columns.iter().position(|c| c.asked.quantity == quantity && c.axis.is_none())
}

impl Place {
    /// Where it is, SI units.
    fn at(&self, numbers: &Numbers) -> Option<[f64; 2]> {
        let coordinate = |axis: usize| -> Option<f64> {
            self.terms.iter().try_fold(0.0, |sum, (sign, output)| {
                Some(sum + f64::from(*sign) * (*numbers.get(output + axis)?)?)
            })
        };
        Some([coordinate(0)?, coordinate(1)?])
    }
}

/// Numbers at one place of the course.
fn numbers(sweep: &Sweep, at: f64) -> Option<Numbers> {
    sweep.positions(&[at]).into_iter().next().map(|position| position.values)
}

impl Diagrams {
    pub(super) fn of(
        scene: &Scene,
        construction: &Construction,
        sweep: &Sweep,
        language: Language,
    ) -> Result<Self, LiveError> {
        let draughts = Draughts::new(scene, construction, language);
        let construction = draughts.construction();
        let frames: Vec<f64> =
            sweep.equal_steps(FRAMES).into_iter().filter(|at| sweep.stretch_at(*at).is_some()).collect();
        let course: Vec<Numbers> = frames.iter().filter_map(|at| numbers(sweep, *at)).collect();
        let start = numbers(sweep, sweep.start)
            .ok_or(LiveError::Number("the scene's own position lies on no stretch of its course"))?;
        let sketches = sketches(scene, construction, sweep, &start);
        let scales = scales(scene, &sketches, &course);
        let mut drawn = drawn(scene, sweep, scales, language)?;
        drawn.shortest = shortest(sweep, &course, &start);
        let layers: Vec<Sketch> = (0..drawn.layers.first().map_or(0, Vec::len))
            .filter_map(|layer| Some(with_centres(sketches.first()?, layer, construction, sweep)))
            .collect();
        let mut drafted: Vec<(Panel, Vec<Spotted>)> = Vec::new();
        for sketch in sketches.into_iter().chain(layers) {
            drafted.extend(panel(drafted.len(), sketch, (scene, sweep), &drawn, (&course, &start), scales));
        }
        let is_small = |(panel, _): &(Panel, Vec<Spotted>)| panel.is_small(&course, &start);
        // Along both axes together no faster than a millimetre in a degree, or in as small a part of the range.
        let whole = match sweep.input {
            InputKind::Angle(_) => (sweep.range[1] - sweep.range[0]).to_degrees(),
            InputKind::Slide(_) | InputKind::Time => 360.0,
        };
        let glide = FRAC_1_SQRT_2 * whole / f64::from(FRAMES);
        // The frame at which the page opens, or next to it.
        let off = |at: &f64| {
            let way = (at - sweep.start).abs();
            if sweep.whole_turn { way.min(sweep.range[1] - sweep.range[0] - way) } else { way }
        };
        let nearest = frames.iter().enumerate().min_by(|a, b| off(a.1).total_cmp(&off(b.1)));
        let own = nearest.map_or(0, |(frame, _)| frame);
        let refit = scene.sheet.live.refit.unwrap_or_else(|| drafted.iter().any(is_small));
        let place = |(index, (mut panel, spots)): (usize, (Panel, Vec<Spotted>))| {
            place_names(&mut panel, index, spots, (&course, &start), (sweep.whole_turn, glide, own), refit);
            panel
        };
        let mut panels: Vec<Panel> = drafted.into_iter().enumerate().map(place).collect();
        panels.extend(drawn.circle.as_ref().map(|(ink, title)| circle(ink, title)));
        Ok(Self { panels, drawn, refit })
    }

    /// Whether anything moves as only what is drawn over a skeleton does, or a pin leaves its slot.
    pub(super) fn has_layers(&self) -> bool {
        let is_layer = |moving: &Moving| matches!(moving.by, Move::Through(..) | Move::Round(..));
        self.panels.iter().any(|panel| !panel.openings.is_empty() || panel.moving.iter().any(is_layer))
    }

    /// The panels, by index, that are not among those which are to be open; none where none of these is there.
    pub(super) fn closed(&self, open: &[&str]) -> Vec<usize> {
        let figure = |panel: &Panel| match panel.shows {
            Shows::Diagram => panel.kind.figure(),
            Shows::Layer(index) => {
                self.drawn.layers.first().and_then(|all| all.get(index)).map_or("", |layer| layer.figure)
            }
            Shows::Circle => "circle",
        };
        let is_open = |panel: &Panel| open.contains(&figure(panel));
        if !self.panels.iter().any(is_open) {
            return Vec::new();
        }
        (0..self.panels.len()).filter(|index| !is_open(&self.panels[*index])).collect()
    }

    /// What is said of the steps, with what their numbers hang on.
    pub(super) fn said(&self, sweep: &Sweep, input: f64, language: Language) -> Vec<Value> {
        let drawn = &self.drawn;
        let draughts = drawn.draughts(language);
        let Some(first) = draughts.first() else { return Vec::new() };
        let order = |kind: DiagramKind| {
            move |of: Quantity| match kind {
                DiagramKind::Skeleton => false,
                DiagramKind::Velocity => of.order() == Order::Velocity,
                DiagramKind::Acceleration => of.order() == Order::Acceleration,
            }
        };
        let tests: Vec<_> = self.panels.iter().map(|panel| order(panel.kind)).collect();
        let polygons: Vec<Paper<'_>> = self
            .panels
            .iter()
            .zip(&tests)
            .enumerate()
            .map(|(index, (panel, on))| (index, panel.si_per_mm, on as &dyn Fn(Quantity) -> bool))
            .collect();
        let printed = Printed::of(sweep, (&drawn.places, &drawn.numbers), &polygons, input, first.senses());
        let said = |lengths: Lengths| -> Vec<Vec<Said>> {
            draughts.iter().map(|draughts| draughts.said(lengths)).collect()
        };
        let taken = TAKEN.map(|lengths| (lengths, said(lengths)));
        printed.steps(&said(Lengths::Drawn), &taken, &drawn.shortest, &first.of_an_instant())
    }

    pub(super) fn json(&self) -> Value {
        let panels: Vec<Value> = self.panels.iter().map(Panel::json).collect();
        let ink = self.panels.iter().enumerate().flat_map(|(index, panel)| {
            panel.moving.iter().filter(|m| m.by != Move::Whole(Frame::Fixed)).map(move |m| m.json(index))
        });
        let labels = self
            .panels
            .iter()
            .enumerate()
            .flat_map(|(index, panel)| panel.names.iter().map(move |name| name.json(index)));
        json!({
            "panels": panels,
            "ink": ink.collect::<Vec<_>>(),
            "labels": labels.collect::<Vec<_>>(),
            "frames": FRAMES,
        })
    }
}

/// The circle diagram, which is the same in every position.
fn circle(ink: &Group, title: &str) -> Panel {
    Panel {
        kind: DiagramKind::Skeleton,
        shows: Shows::Circle,
        title: crate::markup::escaped(title),
        scale_text: String::new(),
        ink: ink.clone(),
        shown: ink.bounds().unwrap_or(Rect::ZERO).inflate(4.0, 4.0),
        si_per_mm: 1.0,
        over: Vec::new(),
        unit: Unit { symbol: String::new(), si: 1.0 },
        origin: [0.0; 2],
        places: Vec::new(),
        own_places: 0,
        moving: Vec::new(),
        names: Vec::new(),
        openings: Vec::new(),
    }
}

/// The skeleton once more, with the instant centres among its places.
fn with_centres(skeleton: &Sketch, layer: usize, construction: &Construction, sweep: &Sweep) -> Sketch {
    let mut sketch = skeleton.clone();
    sketch.layer = Some(layer);
    for centre in construction.circle.iter().flat_map(|circle| &circle.centres) {
        let [i, j] = centre.links;
        if let Some(x) =
            column(sweep, Quantity::Centre(i, j)).or_else(|| column(sweep, Quantity::Centre(j, i)))
        {
            sketch.places.push(Place { terms: vec![(1, x)] });
        }
    }
    sketch
}

/// The places of a diagram, before its scale is known.
#[derive(Clone)]
struct Sketch {
    kind: DiagramKind,
    layer: Option<usize>,
    places: Vec<Place>,
    /// Of a skeleton the points, of a polygon the names of the places.
    points: Vec<PointId>,
    labels: Vec<Label>,
    origin: [f64; 2],
}

fn sketches(scene: &Scene, construction: &Construction, sweep: &Sweep, start: &Numbers) -> Vec<Sketch> {
    let mechanism = &scene.mechanism;
    let (mut points, mut places) = (Vec::new(), Vec::new());
    for point in (0..mechanism.points.len()).map(PointId) {
        let drawn = construction.space.places[point.0].is_some();
        if let (true, Some(x)) = (drawn, column(sweep, Quantity::Position(point))) {
            points.push(point);
            places.push(Place { terms: vec![(1, x)] });
        }
    }
    let origin = crate::graphical::origin(mechanism);
    let mut all =
        vec![Sketch { kind: DiagramKind::Skeleton, layer: None, places, points, labels: Vec::new(), origin }];
    for polygon in &construction.diagrams {
        let (labels, places) = images(scene, polygon, sweep, start);
        all.push(Sketch {
            kind: polygon.kind,
            layer: None,
            places,
            points: Vec::new(),
            labels,
            origin: [0.0; 2],
        });
    }
    all
}

/// The images of a polygon with the outputs that tell where they are: those of points by their own vectors, ends of
/// components by the vectors that lead to them. What the outputs do not put where it was drawn is left out.
fn images(scene: &Scene, polygon: &Diagram, sweep: &Sweep, start: &Numbers) -> (Vec<Label>, Vec<Place>) {
    let mechanism = &scene.mechanism;
    let absolute = |point: PointId, link: Option<LinkId>| {
        let under = link.filter(|link| !mechanism.link(*link).points.contains(&point));
        match (polygon.kind, under) {
            (DiagramKind::Acceleration, Some(link)) => Some(Quantity::CoincidentAcceleration(point, link)),
            (DiagramKind::Acceleration, None) => Some(Quantity::Acceleration(point)),
            (DiagramKind::Velocity, Some(link)) => Some(Quantity::CoincidentVelocity(point, link)),
            (DiagramKind::Velocity, None) => Some(Quantity::Velocity(point)),
            _ => None,
        }
    };
    let mut known: Vec<(Label, Place)> = vec![(Label::Pole, Place { terms: Vec::new() })];
    for image in &polygon.images {
        if let Label::Image { point, link } = image.label
            && !known.iter().any(|(label, _)| *label == image.label)
            && let Some(x) = absolute(point, link).and_then(|quantity| column(sweep, quantity))
        {
            known.push((image.label, Place { terms: vec![(1, x)] }));
        }
    }
    // Chains of components, from what is known on.
    let mut found = true;
    while std::mem::take(&mut found) {
        for vector in &polygon.vectors {
            let place =
                |label: Label| known.iter().find(|(l, _)| *l == label).map(|(_, place)| place.clone());
            let Some(x) = column(sweep, vector.quantity) else { continue };
            let (label, from, sign) = match (place(vector.tail), place(vector.head)) {
                (Some(tail), None) => (vector.head, tail, 1),
                (None, Some(head)) => (vector.tail, head, -1),
                _ => continue,
            };
            let mut terms = from.terms;
            terms.push((sign, x));
            known.push((label, Place { terms }));
            found = true;
        }
    }
    known.retain(|(label, place)| {
        let Some(image) = polygon.images.iter().find(|image| image.label == *label) else {
            return *label == Label::Pole;
        };
        let Some(at) = place.at(start) else { return false };
        let size = libm::hypot(image.at[0], image.at[1]).max(1.0);
        (0..2).all(|axis| (at[axis] / polygon.si_per_mm - image.at[axis]).abs() <= 1e-7 * size)
    });
    known.into_iter().unzip()
}

/// The scales for the whole course.
fn scales(scene: &Scene, sketches: &[Sketch], course: &[Numbers]) -> Scales {
    let units = &scene.units;
    let mut scales = Scales::new(|_| 1e-2);
    for sketch in sketches {
        let places = |numbers: &Numbers| -> Vec<[f64; 2]> {
            let places = sketch.places.iter().filter_map(|place| place.at(numbers));
            places.filter(|at| at.iter().all(|x| x.is_finite())).collect()
        };
        let mut sets: Vec<Vec<[f64; 2]>> = course.iter().map(places).collect();
        if sketch.kind != DiagramKind::Skeleton {
            let reach =
                |set: &Vec<[f64; 2]>| set.iter().map(|at| libm::hypot(at[0], at[1])).fold(0.0, f64::max);
            sets.sort_by(|a, b| reach(a).total_cmp(&reach(b)));
            sets.truncate((sets.len() * COUNTED).div_ceil(100).max(1));
        }
        let all: Vec<[f64; 2]> = sets.into_iter().flatten().collect();
        let extent = |axis: usize| {
            let values = all.iter().map(|at| at[axis]);
            let (low, high) = values.fold((0.0_f64, 0.0_f64), |(low, high), x| (low.min(x), high.max(x)));
            high - low
        };
        let (width, height) =
            if sketch.kind == DiagramKind::Skeleton { reach_of(&all) } else { (extent(0), extent(1)) };
        let dimension = sketch.kind.dimension();
        let time = units.time.si;
        let sheet = &scene.sheet;
        let chosen = match dimension {
            Dimension::Length => sheet
                .length_scale
                .map(|ratio| ratio / 1000.0)
                .or_else(|| scale::choose_length(width, height, SKELETON)),
            Dimension::Velocity => sheet
                .velocity_scale
                .or_else(|| scale::choose_for(width, height, POLYGON, units.length.si / time)),
            Dimension::Acceleration => sheet
                .acceleration_scale
                .or_else(|| scale::choose_for(width, height, POLYGON, units.length.si / (time * time))),
        };
        if let Some(chosen) = chosen {
            scales = scales.with(dimension, chosen);
        }
    }
    scales
}

fn reach_of(all: &[[f64; 2]]) -> (f64, f64) {
    let side = |axis: usize| {
        let low = all.iter().map(|at| at[axis]).fold(f64::INFINITY, f64::min);
        let high = all.iter().map(|at| at[axis]).fold(f64::NEG_INFINITY, f64::max);
        if high > low { high - low } else { 0.0 }
    };
    (side(0), side(1))
}

/// The diagrams at some positions of the course; the scene's own is the first.
#[derive(Debug)]
struct Drawn {
    /// What is varied.
    places: Vec<f64>,
    numbers: Vec<Numbers>,
    scenes: Vec<Scene>,
    constructions: Vec<Construction>,
    diagrams: Vec<Vec<Drawing>>,
    layers: Vec<Vec<Layer>>,
    circle: Option<(Group, String)>,
    /// Of the scene's own position.
    names: Names,
    language: Language,
    /// See [`shortest`].
    shortest: Vec<f64>,
}

/// What has one name, and the name.
type Named<T> = (Vec<T>, Name);

/// What a name hangs on: a point, or the ends of a stroke, each in its frame.
type Anchors = Vec<(Frame, Vec2)>;

/// A name that is to be placed along the course.
#[derive(Debug, Clone)]
struct Spotted {
    name: Name,
    anchors: Anchors,
    /// The step that draws what it names.
    step: Option<usize>,
    /// It stands while the output of this index is known and not zero.
    output: Option<usize>,
}

impl Spotted {
    fn new(name: Name, anchors: Anchors) -> Self {
        let step = name.life().map(|life| life.born.step);
        Self { name, anchors, step, output: None }
    }
}

/// What only the sheet can say, by polygon.
#[derive(Debug, Default)]
struct Names {
    images: Vec<(DiagramKind, Vec<Named<Label>>)>,
    vectors: Vec<(DiagramKind, Vec<Named<usize>>)>,
    rotations: Vec<(String, LinkId, bool)>,
    quantities: Vec<(DiagramKind, Vec<String>)>,
    scales: Vec<(DiagramKind, String)>,
    units: Vec<(DiagramKind, Unit)>,
}

/// By output the least length of the vector that begins with it, over the course; what begins none has none.
fn shortest(sweep: &Sweep, course: &[Numbers], start: &Numbers) -> Vec<f64> {
    let length = |index: usize, numbers: &Numbers| Some(libm::hypot(numbers[index]?, numbers[index + 1]?));
    let least = |(index, column): (usize, &Column)| match column.axis {
        Some(0) => {
            let lengths = course.iter().chain([start]).filter_map(|numbers| length(index, numbers));
            lengths.fold(f64::INFINITY, f64::min)
        }
        _ => f64::INFINITY,
    };
    sweep.columns.iter().enumerate().map(least).collect()
}

fn drawn(scene: &Scene, sweep: &Sweep, scales: Scales, language: Language) -> Result<Drawn, LiveError> {
    let mut all = Drawn {
        places: Vec::new(),
        scenes: Vec::new(),
        numbers: Vec::new(),
        constructions: Vec::new(),
        diagrams: Vec::new(),
        layers: Vec::new(),
        circle: None,
        names: Names::default(),
        language,
        shortest: Vec::new(),
    };
    let home = sweep.stretch_at(sweep.start).cloned();
    let inside = home.into_iter().flat_map(|home| {
        // Where nothing in particular happens.
        let parts = [0.137, 0.291, 0.453, 0.613, 0.789, 0.911, 0.227, 0.543];
        parts.map(|part| home.from + (home.to - home.from) * part)
    });
    for at in std::iter::once(sweep.start).chain(inside) {
        if all.constructions.len() == DRAWN {
            break;
        }
        let (Some(mechanism), Some(numbers)) = (sweep.mechanism_at(at), numbers(sweep, at)) else { continue };
        let mechanism = if at == sweep.start { mechanism } else { as_stated(mechanism, &scene.mechanism) };
        let mut moved = scene.clone();
        // By the methods that were asked for, which a sweep does not know.
        moved.mechanism = Mechanism { asked: scene.mechanism.asked.clone(), ..mechanism };
        moved.sheet.positions.clear();
        moved.sheet.other_assembly = false;
        // Elsewhere what is varied has another angle than the stated one.
        for (input, units) in moved.mechanism.inputs.iter().zip(&mut moved.input_units) {
            let is_varied = match (sweep.input, input) {
                (InputKind::Angle(varied), Input::Angle { link, .. } | Input::Speed { link, .. }) => {
                    *link == varied
                }
                (InputKind::Time, _) => true,
                _ => false,
            };
            units.angle = units.angle.filter(|_| at == sweep.start || !is_varied);
        }
        let solved = solve_with(&moved, Extent::WholeSkeleton, &[], Settings::default(), |_, _| scales);
        let solved = match solved {
            Ok(solved) => solved,
            Err(why) if all.constructions.is_empty() => return Err(why.into()),
            Err(_) => continue,
        };
        let draughts = Draughts::new(&moved, &solved.solution.construction, language);
        let construction = draughts.construction().clone();
        if all.constructions.is_empty() {
            all.names = names(scene, &construction, &draughts);
            all.circle = draughts.circle();
        }
        all.layers.push(draughts.layers());
        all.numbers.push(numbers);
        all.constructions.push(construction);
        all.places.push(at);
        all.scenes.push(moved);
    }
    // What turns anywhere has its arrow everywhere: where a page opens a link may stand still.
    let draughts = all.draughts(language);
    let mut turning: Vec<(LinkId, bool)> = draughts.iter().flat_map(Draughts::turning).collect();
    turning.sort_unstable();
    turning.dedup();
    all.diagrams = draughts.iter().map(|draughts| draughts.diagrams(&turning)).collect();
    Ok(all)
}

impl Drawn {
    /// How each position is drawn.
    fn draughts(&self, language: Language) -> Vec<Draughts<'_>> {
        let each = self.scenes.iter().zip(&self.constructions);
        each.map(|(scene, construction)| Draughts::new(scene, construction, language)).collect()
    }
}

/// The mechanism of another position as the scene states it: what is found there is found, though it was placed for whoever cannot
/// tell how far a wheel has rolled; and no wheel has a mark that says so.
fn as_stated(mut mechanism: Mechanism, stated: &Mechanism) -> Mechanism {
    mechanism.points.truncate(stated.points.len());
    for (point, own) in mechanism.points.iter_mut().zip(&stated.points) {
        if let (MechanismPlace::Placed(at), MechanismPlace::Near(_) | MechanismPlace::Unknown) =
            (&point.place, &own.place)
        {
            point.place = MechanismPlace::Near(at.map(|along| along.value));
        }
    }
    for (link, own) in mechanism.links.iter_mut().zip(&stated.links) {
        link.points.clone_from(&own.points);
        link.form.clone_from(&own.form);
    }
    mechanism
}

fn names(scene: &Scene, construction: &Construction, draughts: &Draughts<'_>) -> Names {
    let mut all = Names::default();
    for link in scene.mechanism.moving() {
        for (quantity, second) in [(Quantity::Omega(link), false), (Quantity::Alpha(link), true)] {
            all.rotations.push((draughts.quantity_name(quantity), link, second));
        }
    }
    all.units.push((DiagramKind::Skeleton, draughts.unit(Dimension::Length)));
    all.scales
        .push((DiagramKind::Skeleton, draughts.scale(Dimension::Length, construction.space.metres_per_mm)));
    for polygon in &construction.diagrams {
        let kind = polygon.kind;
        // One name for every label; for vectors one for every stroke.
        let mut labels: Vec<Label> = vec![Label::Pole];
        for image in &polygon.images {
            if !labels.contains(&image.label) {
                labels.push(image.label);
            }
        }
        let named = labels.into_iter();
        let named = named.filter_map(|label| Some((vec![label], draughts.name_of_images(kind, &[label])?)));
        all.images.push((kind, named.collect()));
        let mut strokes: Vec<(Label, Label, Vec<usize>)> = Vec::new();
        for (index, vector) in polygon.vectors.iter().enumerate() {
            match strokes.iter_mut().find(|(tail, head, _)| *tail == vector.tail && *head == vector.head) {
                Some((.., own)) => own.push(index),
                None => strokes.push((vector.tail, vector.head, vec![index])),
            }
        }
        let strokes = strokes.into_iter();
        let named = strokes.filter_map(|(.., own)| {
            let name = draughts.name_of_vectors(kind, &own)?;
            Some((own, name))
        });
        all.vectors.push((kind, named.collect()));
        let quantities = polygon.vectors.iter().map(|v| draughts.quantity_name(v.quantity));
        all.quantities.push((kind, quantities.collect()));
        all.units.push((kind, draughts.unit(kind.dimension())));
        all.scales.push((kind, draughts.scale(kind.dimension(), polygon.si_per_mm)));
    }
    all
}

fn of_kind<T>(all: &[(DiagramKind, T)], kind: DiagramKind) -> Option<&T> {
    all.iter().find(|(own, _)| *own == kind).map(|(_, of)| of)
}

impl Panel {
    /// The quantities, by their names, that arrows over a skeleton show.
    pub(super) fn arrows(&self) -> impl Iterator<Item = &str> {
        let arrows = self.moving.iter().filter(|moving| matches!(moving.by, Move::Arrow(..)));
        arrows
            .flat_map(|moving| &moving.ink.data)
            .filter(|(name, _)| *name == "of")
            .map(|(_, of)| of.as_str())
    }

    fn seen(&self, numbers: &Numbers) -> Seen {
        self.seen_at(numbers, self.si_per_mm)
    }

    /// The scale that fits a polygon to one position, by the rule for one position.
    fn fitted(&self, numbers: &Numbers) -> Option<f64> {
        if self.kind == DiagramKind::Skeleton {
            return None;
        }
        let part = |x: f64, low: f64, high: f64| match x {
            0.0 => 0.0,
            x if x > 0.0 => x / (high - BORDER),
            x => x / (low + BORDER),
        };
        let seen = self.seen_at(numbers, 1.0);
        let parts = seen.places.iter().flatten().flat_map(|at| {
            [part(at.x, self.shown.x0, self.shown.x1), part(at.y, self.shown.y0, self.shown.y1)]
        });
        let unit = self.unit.si / 10.0;
        Some(scale::round_up(parts.fold(0.0, f64::max) / unit)? * unit)
    }

    /// Whether a polygon is too small to be read at the scale of the course: at the scene's own position, or in most.
    fn is_small(&self, course: &[Numbers], start: &Numbers) -> bool {
        let is_small = |numbers: &&Numbers| {
            self.fitted(numbers).is_some_and(|fitted| fitted * SMALLEST_PART <= self.si_per_mm)
        };
        is_small(&start) || 2 * course.iter().filter(is_small).count() > course.len()
    }

    fn seen_at(&self, numbers: &Numbers, si_per_mm: f64) -> Seen {
        let page = |at: [f64; 2]| {
            let [x, y] = [0, 1].map(|axis| (at[axis] - self.origin[axis]) / si_per_mm);
            let at = Point::new(x, -y);
            at.is_finite().then_some(at)
        };
        let places = self.places.iter().map(|place| place.at(numbers).and_then(page)).collect();
        Seen { places, numbers: numbers.clone() }
    }

    /// The end of a stroke at a pin that leaves its slot, where that ends instead.
    fn held(&self, (frame, own): (Frame, Vec2)) -> (Frame, Vec2) {
        let of = |leaving: &&Leaving| frame == Frame::At(leaving.ends[0]) && own.hypot() < 1e-6;
        match self.openings.iter().find(of) {
            Some(&Leaving { ends: [pin, pivot], reach, .. }) => {
                (Frame::Rigid(pivot, pin), Vec2::new(reach, 0.0))
            }
            None => (frame, own),
        }
    }

    /// Whether names that find no room beside what they name are tied to it by a line.
    fn has_ties(&self) -> bool {
        self.kind != DiagramKind::Skeleton || matches!(self.shows, Shows::Layer(_))
    }

    fn json(&self) -> Value {
        let shown = [self.shown.x0, self.shown.y0, self.shown.x1, self.shown.y1];
        let mut told = json!({
            "class": self.ink.class,
            "own": self.own_places,
            "layer": matches!(self.shows, Shows::Layer(_)),
            "polygon": self.kind != DiagramKind::Skeleton,
            "ties": self.has_ties(),
            "still": self.moving.iter().filter(|moving| moving.by == Move::Still).count(),
            "box": shown,
            "origin": self.origin,
            "si_per_mm": self.si_per_mm,
            "unit": self.unit.si,
            "unit_symbol": moving::unit(&self.unit.symbol),
            "places": self.places.iter().map(|place| &place.terms).collect::<Vec<_>>(),
        });
        if !self.openings.is_empty() {
            let of = |Leaving { ends: [pin, pivot], reach, names: [point, link] }: &Leaving| {
                json!([pin, pivot, reach, point, link])
            };
            told["openings"] = self.openings.iter().map(of).collect();
        }
        told
    }
}

impl Placed {
    fn json(&self, panel: usize) -> Value {
        // Names stand as near as the eye sees.
        let round = |x: f64| (x * 1e5).round() / 1e5;
        let anchors: Vec<Value> = self
            .anchors
            .iter()
            .map(|(frame, own)| json!([frame.json(), [round(own.x), round(own.y)]]))
            .collect();
        // Tenths of a millimetre, each told by its difference from the frame before.
        #[expect(clippy::cast_possible_truncation, reason = "some millimetres")]
        let tenths = |x: f64| (10.0 * x).round() as i32;
        let mut last = [0; 2];
        let mut by = String::with_capacity(2 * self.by.len());
        for way in &self.by {
            let now = [tenths(way.x), tenths(way.y)];
            now.iter().zip(last).for_each(|(now, last)| coded(now - last, &mut by));
            last = now;
        }
        let half = [self.half.x, self.half.y].map(|x| (x * 100.0).round() / 100.0);
        let by = shortened(&by);
        let mut label = json!({
            "panel": panel, "id": self.id, "anchors": anchors, "by": by, "step": self.step,
            "half": half,
        });
        if !self.of.is_empty() {
            label["of"] = json!(self.of);
        }
        if self.is_of_point {
            label["point"] = json!(true);
        }
        if self.is_of_arrow {
            label["arrow"] = json!(true);
        }
        if let Some(output) = self.output {
            label["output"] = json!(output);
        }
        label
    }
}

/// Runs of no difference, told by how long they are between `~` and a comma: names mostly stay where they are.
fn shortened(letters: &str) -> String {
    let mut out = String::with_capacity(letters.len() / 4);
    let mut rest = letters;
    while let Some(first) = rest.chars().next() {
        let run = rest.len() - rest.trim_start_matches('U').len();
        if run > 4 {
            out.push_str(&format!("~{run},"));
            rest = &rest[run..];
        } else {
            out.push(first);
            rest = &rest[first.len_utf8()..];
        }
    }
    out
}

/// A small whole number as one letter, `U` for none; a larger one as digits between `z` and a comma.
fn coded(number: i32, into: &mut String) {
    const LETTERS: &[u8; 61] = b"0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxy";
    let letter = usize::try_from(number + 30).ok().and_then(|index| LETTERS.get(index));
    match letter {
        Some(letter) => into.push(char::from(*letter)),
        None => into.push_str(&format!("z{number},")),
    }
}

fn panel(
    index: usize,
    sketch: Sketch,
    (scene, sweep): (&Scene, &Sweep),
    drawn: &Drawn,
    (course, start): (&[Numbers], &Numbers),
    scales: Scales,
) -> Option<(Panel, Vec<Spotted>)> {
    let kind = sketch.kind;
    let si_per_mm = scales.of(kind.dimension());
    let own: Vec<&Drawing> =
        drawn.diagrams.iter().filter_map(|all| all.iter().find(|d| d.kind == kind)).collect();
    let first = *own.first()?;
    let mut panel = Panel {
        kind,
        shows: sketch.layer.map_or(Shows::Diagram, Shows::Layer),
        title: crate::markup::escaped(&first.title),
        scale_text: of_kind(&drawn.names.scales, kind).cloned().unwrap_or_default(),
        ink: Group::new(first.ink.class.clone()),
        shown: Rect::ZERO,
        si_per_mm,
        over: Vec::new(),
        unit: of_kind(&drawn.names.units, kind)?.clone(),
        origin: sketch.origin,
        own_places: if kind == DiagramKind::Skeleton { sketch.points.len() } else { sketch.places.len() },
        places: sketch.places,
        moving: Vec::new(),
        names: Vec::new(),
        openings: Vec::new(),
    };
    let binder = binder(&panel, sweep, &drawn.numbers);
    let mut spots: Vec<Spotted> = Vec::new();
    if kind == DiagramKind::Skeleton {
        let points = &sketch.points;
        let numbers = (&scene.mechanism, sweep, course);
        let arrows = skeleton(&mut panel, index, (&own, points), &binder, numbers, &drawn.names);
        panel.openings = leaving(&first.openings, points, &scene.mechanism);
        spots.extend(names_of_skeleton(&own, &binder, &panel, &arrows));
        if let Some(layer) = sketch.layer {
            // Of an instant of the input only how the links stand and what is drawn over them.
            let same: Vec<&Layer> = drawn.layers.iter().filter_map(|all| all.get(layer)).collect();
            panel.title = same.first().map_or_else(String::new, |layer| layer.title.clone());
            spots.retain(|spot| matches!(spot.name.class(), "label point-name" | "label link-number"));
            panel.over = scales_of(&same);
            if let (Some(construction), Some(scene)) = (drawn.constructions.first(), drawn.scenes.first()) {
                let draughts = Draughts::new(scene, construction, drawn.language);
                panel.scale_text = draughts.scales(si_per_mm, &panel.over);
            }
            spots.extend(lay_over(&mut panel, index, &same, &binder));
        }
    } else {
        let construction = drawn.constructions.first()?;
        let polygon = construction.diagram(kind)?;
        let others = drawn.constructions.iter().skip(1).filter_map(|other| other.diagram(kind));
        let polygons: Vec<&Diagram> = std::iter::once(polygon).chain(others).collect();
        polygon_ink(&mut panel, index, first, &polygons, &sketch.labels, &drawn.names);
        spots.extend(names_of_polygon(polygon, &sketch.labels, &panel, &drawn.names));
    }
    panel.shown = shown(&panel, course, start);
    Some((panel, spots))
}

fn leaving(openings: &[Opening], points: &[PointId], mechanism: &Mechanism) -> Vec<Leaving> {
    let place = |point: PointId| points.iter().position(|own| *own == point);
    let of = |opening: &Opening| {
        let ends = [place(opening.pin)?, place(opening.pivot)?];
        let link = mechanism.link(opening.link).number.to_string();
        let names = [mechanism.point(opening.pin).name.clone(), link];
        Some(Leaving { ends, reach: opening.reach, names })
    };
    openings.iter().filter_map(of).collect()
}

/// What of the plane is shown: everything over the course, of a polygon as far as its scale counts.
fn shown(panel: &Panel, course: &[Numbers], start: &Numbers) -> Rect {
    // What a layer adds to the skeleton may run off the paper.
    let count = panel.own_places;
    let places = |numbers: &Numbers| -> Option<Vec<Point>> {
        panel.seen(numbers).places.into_iter().take(count).collect()
    };
    let mut all = places(start).into_iter().flatten().fold(Rect::ZERO, |all, at| all.union_pt(at));
    let most = if panel.kind == DiagramKind::Skeleton { 1e4 } else { POLYGON.0.max(POLYGON.1) * 1.02 };
    for seen in course.iter().filter_map(places) {
        if seen.iter().all(|at| at.to_vec2().hypot() < most) {
            all = seen.into_iter().fold(all, |all, at| all.union_pt(at));
        }
    }
    let home = panel.seen(start);
    let mut ink = all;
    if panel.kind == DiagramKind::Skeleton {
        ink = panel.ink.bounds().unwrap_or(all);
        // Wheels and plates reach beyond the places of their links; what is drawn over them may run off the paper.
        let is_whole = matches!(panel.shows, Shows::Diagram);
        let body = |moving: &&Moving| is_whole && matches!(moving.by, Move::Whole(_));
        for seen in course.iter().map(|numbers| panel.seen(numbers)) {
            let moved = panel.moving.iter().filter(body).filter_map(|moving| moving.moved(&home, &seen));
            let near = |bounds: &Rect| bounds.width().max(bounds.height()) < most;
            ink = moved.filter_map(|own| own.bounds()).filter(near).fold(ink, |all, own| all.union(own));
        }
    }
    let mut shown = all.union(ink).inflate(BORDER, BORDER);
    let mut grow = |at: Point, around: f64| {
        let grown = shown.union(Rect::from_center_size(at, (2.0 * around, 2.0 * around)));
        if grown.width() <= LARGEST.0.max(shown.width()) && grown.height() <= LARGEST.1.max(shown.height()) {
            shown = grown;
        }
    };
    // As many of what a layer adds as find room, at the scene's own position; and of its arrows over the course.
    home.places.iter().skip(count).flatten().for_each(|at| grow(*at, BORDER));
    let arrows: Vec<&[(Frame, Vec2); 2]> = panel
        .moving
        .iter()
        .filter_map(|moving| match &moving.by {
            Move::Arrow(ends) => Some(ends),
            _ => None,
        })
        .collect();
    for seen in course.iter().filter(|_| !arrows.is_empty()).map(|numbers| panel.seen(numbers)) {
        let tips = arrows.iter().filter_map(|[_, (frame, own)]| frame.global(*own, &seen));
        tips.for_each(|tip| grow(tip, ROOM));
    }
    shown
}

/// The scales of a layer that are the same in every position.
fn scales_of(same: &[&Layer]) -> Vec<LayerScale> {
    let Some((first, others)) = same.split_first() else { return Vec::new() };
    let is_same = |(own, other): (&LayerScale, &LayerScale)| {
        own.dimension == other.dimension
            && (own.si_per_mm - other.si_per_mm).abs() <= 1e-9 * own.si_per_mm.abs()
    };
    let alike = |other: &&Layer| {
        other.scales.len() == first.scales.len() && first.scales.iter().zip(&other.scales).all(is_same)
    };
    if others.iter().all(alike) { first.scales.clone() } else { Vec::new() }
}

/// Draws a layer over its skeleton; its names with what they hang on.
fn lay_over(panel: &mut Panel, index: usize, same: &[&Layer], binder: &Binder) -> Vec<Spotted> {
    let Some((first, whole)) = same.first().zip(Some(same.len() == binder.seen.len())) else {
        return Vec::new();
    };
    let mut ink = Group::new("layer");
    let everywhere = |of: &dyn Fn(&Layer) -> Option<Point>| -> Option<Vec<Point>> {
        same.iter().map(|layer| of(layer)).collect::<Option<Vec<_>>>().filter(|_| whole)
    };
    for (number, stroke) in first.strokes.iter().enumerate() {
        let alike = |layer: &&&Layer| {
            layer.strokes.len() == first.strokes.len()
                && layer.strokes[number].at.len() == stroke.at.len()
                && std::mem::discriminant(&layer.strokes[number].way) == std::mem::discriminant(&stroke.way)
        };
        let ends = || -> Vec<Option<(Frame, Vec2)>> {
            let end = |k: usize| binder.bound(&everywhere(&|layer: &Layer| layer.strokes[number].at[k])?);
            (0..stroke.at.len()).map(end).collect()
        };
        let mut by = Move::Still;
        if same.iter().filter(alike).count() == same.len() {
            let ends = ends();
            let all: Option<Vec<(Frame, Vec2)>> = ends.iter().copied().collect();
            by = match (stroke.way, all) {
                // A centre that is always at infinity is no point of its line.
                (Way::Through, _) if ends.iter().flatten().count() >= 2 => {
                    Move::Through(ends.into_iter().flatten().collect(), PAST)
                }
                (Way::Within, Some(ends)) => Move::Through(ends, 0.0),
                (Way::Arrow, Some(ends)) if ends.len() == 2 => Move::Arrow([ends[0], ends[1]]),
                (Way::Line, Some(ends)) => Move::Strokes(vec![(false, ends)]),
                (Way::Circle(_), Some(centre)) => {
                    let radius = |layer: &&Layer| match layer.strokes[number].way {
                        Way::Circle(radius) => radius,
                        _ => 0.0,
                    };
                    let radii: Vec<f64> = same.iter().map(radius).collect();
                    match binder.part_of(&radii) {
                        Some(part) => Move::Round(centre[0], part),
                        None => Move::Still,
                    }
                }
                _ => Move::Still,
            };
        }
        let known: Vec<Point> = stroke.at.iter().flatten().copied().collect();
        let (Some(from), Some(to)) = (known.first(), known.last()) else { continue };
        let id = format!("d{index}o{number}");
        let mut own = Group::new(stroke.class);
        if !stroke.of.is_empty() {
            own = own.data("of", stroke.of.clone());
        }
        own.id = Some(id.clone());
        match stroke.way {
            Way::Circle(radius) => {
                own.mark(Mark::stroke(Shape::Circle { centre: *from, radius }, stroke.pen).precise());
            }
            Way::Arrow => {
                arrow(&mut own, *from, *to, stroke.pen.width);
                for node in &mut own.children {
                    if let Node::Mark(Mark { class: "shaft", pen: Some(pen), .. }) = node {
                        pen.dash = stroke.pen.dash;
                    }
                }
            }
            Way::Line | Way::Through | Way::Within => {
                own.mark(Mark::stroke(Shape::Line(*from, *to), stroke.pen).precise());
            }
        }
        ink.group(own.clone());
        panel.moving.push(Moving { id, by, quantity: None, sense: None, step: None, ink: own });
    }
    let mut names = Vec::new();
    for (number, point) in first.points.iter().enumerate() {
        let same_names = same.iter().all(|layer| layer.points.len() == first.points.len());
        let at = everywhere(&|layer: &Layer| layer.points.get(number)?.at).filter(|_| same_names);
        let bound = at.and_then(|at| binder.bound(&at));
        let by = match bound {
            Some((Frame::At(place), own)) if own.hypot() < 1e-6 => Move::Whole(Frame::At(place)),
            Some(bound) => Move::Mark(bound),
            None => Move::Still,
        };
        let Some(here) = point.at else { continue };
        if !point.ink.children.is_empty() {
            let id = format!("d{index}q{number}");
            let mut own = point.ink.clone();
            own.translate(here.to_vec2());
            own.id = Some(id.clone());
            ink.group(own.clone());
            panel.moving.push(Moving { id, by, quantity: None, sense: None, step: None, ink: own });
        }
        if let (Some(name), Some(bound)) = (&point.name, bound) {
            names.push(Spotted::new(name.clone(), vec![bound]));
        }
    }
    let has_all = same.iter().all(|layer| layer.names.len() == first.names.len());
    for (number, between) in first.names.iter().enumerate().filter(|_| has_all) {
        let end = |k: usize| binder.bound(&everywhere(&|layer: &Layer| layer.names.get(number)?.at[k])?);
        if let (Some(from), Some(to)) = (end(0), end(1)) {
            names.push(Spotted::new(between.name.clone(), vec![from, to]));
        }
    }
    panel.ink.group(ink);
    names
}

/// Items of the skeleton's ink: the children of its groups, marks each in a group of their own.
fn items(ink: &Group) -> Vec<(String, Vec<Group>)> {
    let group = |node: &Node| match node {
        Node::Group(group) => Some(group.clone()),
        Node::Mark(mark) => {
            let mut own = Group::default();
            own.mark(mark.clone());
            Some(own)
        }
        Node::Text(_) => None,
    };
    let of = |node: &Node| match node {
        Node::Group(all) => Some((all.class.clone(), all.children.iter().filter_map(group).collect())),
        _ => None,
    };
    ink.children.iter().filter_map(of).collect()
}

fn skeleton(
    panel: &mut Panel,
    index: usize,
    (own, points): (&[&Drawing], &[PointId]),
    binder: &Binder,
    (mechanism, sweep, course): (&Mechanism, &Sweep, &[Numbers]),
    names: &Names,
) -> Vec<CurvedArrow> {
    let drawn: Vec<Vec<(String, Vec<Group>)>> = own.iter().map(|diagram| items(&diagram.ink)).collect();
    let mut number = 0;
    let course = panel_seen(panel, course);
    let mut arrows = Vec::new();
    for (t, (class, first)) in drawn[0].iter().enumerate() {
        let mut all = Group::new(class.clone());
        if class == "rotations" {
            // They are of an instant of the input.
            if !matches!(panel.shows, Shows::Layer(_)) {
                arrows = curved_arrows(&drawn, binder, (sweep, points), names);
            }
            for CurvedArrow { output, frame, quantity, ink, .. } in &arrows {
                let is_positive = counterclockwise(ink);
                for (item, is_positive) in [(ink.clone(), is_positive), (mirrored(ink), !is_positive)] {
                    number += 1;
                    let (id, mut ink) = (format!("d{index}s{number}"), item);
                    ink.id = Some(id.clone());
                    all.group(ink.clone());
                    let (by, sense) = (Move::Whole(*frame), Some((*output, is_positive)));
                    let step = ink.life.map(|life| life.born.step);
                    panel.moving.push(Moving { id, by, quantity: Some(quantity.clone()), sense, step, ink });
                }
            }
            panel.ink.group(all);
            continue;
        }
        for (i, item) in first.iter().enumerate() {
            let same: Vec<&Group> = drawn
                .iter()
                .filter_map(|other| {
                    let (_, others) = other.get(t)?;
                    if others.len() == first.len() {
                        return others.get(i);
                    }
                    let keyed = !item.data.is_empty() || !item.class.is_empty();
                    others.iter().find(|o| keyed && o.class == item.class && o.data == item.data)
                })
                .collect();
            let id = |number: &mut usize| {
                *number += 1;
                format!("d{index}s{number}")
            };
            let quantity = item.data.iter().find(|(name, _)| *name == "quantity").map(|(_, of)| of.clone());
            let step = item.life.map(|life| life.born.step);
            let mut add = |item: &Group, by: Move| {
                let id = id(&mut number);
                let mut ink = item.clone();
                ink.id = Some(id.clone());
                all.group(ink.clone());
                panel.moving.push(Moving { id, by, quantity: quantity.clone(), sense: None, step, ink });
            };
            if class == "angles" && matches!(panel.shows, Shows::Layer(_)) {
                continue;
            }
            if class == "angles" {
                let stated = inputs_with_an_angle(mechanism).nth(i);
                for (arc, by) in turns(&same, binder) {
                    let by = match (by, stated) {
                        (Move::Turn(place, radius, _), Some(link)) if sweep.input == InputKind::Time => {
                            let angle = scalar(sweep, Quantity::Angle(link));
                            angle.map_or(Move::Still, |angle| Move::Turn(place, radius, Some(angle)))
                        }
                        // Only one input is varied: another link that is driven stays turned as far as it is.
                        (Move::Turn(place, ..), _) if stated.map(InputKind::Angle) != Some(sweep.input) => {
                            Move::Whole(Frame::At(place))
                        }
                        (by, _) => by,
                    };
                    add(&arc, by);
                }
                continue;
            }
            if let Some((guide, rest)) = ground_of(item) {
                // A wheel rolls on ground that stands still: it is drawn as far as the wheel goes.
                let rests: Vec<Group> =
                    same.iter().filter_map(|other| ground_of(other)).map(|(_, rest)| rest).collect();
                let by = bind(binder, &rests.iter().collect::<Vec<_>>());
                if let Move::Whole(Frame::At(rider)) = by {
                    for copy in along_the_course(&guide, rider, &course, binder) {
                        add(&copy, Move::Whole(Frame::Fixed));
                    }
                    add(&rest, by);
                    continue;
                }
            }
            let mut by = bind(binder, &same);
            // A slot that grows with the way of its rider is none of a rigid link.
            let grows = item.class.contains("slot") && matches!(by, Move::Strokes(_));
            if (by == Move::Still || grows)
                && let Some((rigid, frame)) =
                    as_a_body(item, &same, binder, &course, (mechanism, sweep, points))
            {
                add(&rigid, Move::Whole(frame));
                continue;
            }
            if class == "frame" {
                // The sheet hatches the side where fewer links are, which may change over the course.
                let rider = match by {
                    Move::Whole(Frame::At(rider)) => Some(rider),
                    _ if item.class == "guide" => rider_on(item, binder),
                    _ => None,
                };
                if let Some(rider) = rider {
                    // The frame stands still: its guide is drawn as far as the rider goes.
                    for copy in along_the_course(item, rider, &course, binder) {
                        add(&copy, Move::Whole(Frame::Fixed));
                    }
                    continue;
                }
                by = Move::Whole(Frame::Fixed);
            }
            add(item, by);
        }
        panel.ink.group(all);
    }
    arrows
}

/// A curved arrow of a skeleton.
#[derive(Debug)]
struct CurvedArrow {
    /// What it shows.
    output: usize,
    quantity: String,
    frame: Frame,
    /// At the scene's own position.
    ink: Group,
    /// As it is drawn, and at which of the drawn positions.
    drawn: (usize, Group),
}

/// The curved arrows: of each rotation the one of the first position in which it finds room.
fn curved_arrows(
    drawn: &[Vec<(String, Vec<Group>)>],
    binder: &Binder,
    (sweep, points): (&Sweep, &[PointId]),
    names: &Names,
) -> Vec<CurvedArrow> {
    let mut all: Vec<CurvedArrow> = Vec::new();
    for (position, groups) in drawn.iter().enumerate() {
        for item in groups.iter().filter(|(class, _)| class == "rotations").flat_map(|(_, items)| items) {
            let quantity = item.data.iter().find(|(name, _)| *name == "quantity").map(|(_, of)| of);
            let Some((name, link, second)) = names.rotations.iter().find(|(own, ..)| Some(own) == quantity)
            else {
                continue;
            };
            let of = if *second { Quantity::Alpha(*link) } else { Quantity::Omega(*link) };
            let Some(output) = scalar(sweep, of) else { continue };
            if all.iter().any(|known| known.output == output) {
                continue;
            }
            let frame = frame_of_link(sweep, *link, points);
            let Some(ink) = at_home(item, frame, binder, position) else { continue };
            let (quantity, drawn) = (name.clone(), (position, item.clone()));
            all.push(CurvedArrow { output, quantity, frame, ink, drawn });
        }
    }
    all
}

/// A curved arrow of one of the drawn positions, at the scene's own.
fn at_home(item: &Group, frame: Frame, binder: &Binder, position: usize) -> Option<Group> {
    if position == 0 {
        return Some(item.clone());
    }
    let (home, there) = (binder.seen.first()?, binder.seen.get(position)?);
    let carried = |at: Point| frame.global(frame.local(at, there)?, home);
    let mut own = Group { children: Vec::new(), ..item.clone() };
    for mark in marks(item) {
        let shape = match &mark.shape {
            Shape::Arc { centre, radius, start, sweep } => {
                let begin = carried(crate::sheet::figure::on_circle(*centre, *radius, *start))?;
                let (centre, radius, sweep) = (carried(*centre)?, *radius, *sweep);
                let way = begin - centre;
                Shape::Arc { centre, radius, start: libm::atan2(-way.y, way.x), sweep }
            }
            shape => shape_through(shape, carried)?,
        };
        own.mark(Mark { shape, ..mark.clone() });
    }
    Some(own)
}

/// Whether a curved arrow is drawn that way.
fn counterclockwise(item: &Group) -> bool {
    marks(item).iter().any(|mark| matches!(mark.shape, Shape::Arc { sweep, .. } if sweep > 0.0))
}

fn panel_seen(panel: &Panel, course: &[Numbers]) -> Vec<Seen> {
    course.iter().map(|numbers| panel.seen(numbers)).collect()
}

fn binder(panel: &Panel, sweep: &Sweep, drawn: &[Numbers]) -> Binder {
    let of = |wanted: fn(&Column) -> bool| {
        let columns = sweep.columns.iter().enumerate().filter(move |(_, column)| wanted(column));
        columns.map(|(index, _)| index).collect()
    };
    Binder {
        seen: drawn.iter().map(|numbers| panel.seen(numbers)).collect(),
        angles: of(|column| matches!(column.asked.quantity, Quantity::Angle(_))),
        vectors: of(|c| c.axis == Some(0) && c.asked.quantity.order() != Order::Position),
    }
}

/// The frame of a link: its first two points, or its only one.
fn frame_of_link(sweep: &Sweep, link: LinkId, points: &[PointId]) -> Frame {
    let own = sweep.points_of(link);
    let mut places = own.iter().filter_map(|point| points.iter().position(|p| p == point));
    match (places.next(), places.next()) {
        (Some(a), Some(b)) => Frame::Rigid(a, b),
        (Some(a), None) => Frame::At(a),
        _ => Frame::Fixed,
    }
}

/// The ink of a link that the sheet draws differently in every position, because a slot is as long as its rider goes: a link
/// is rigid, and on the page its slots are as long as their riders ever go.
fn as_a_body(
    item: &Group,
    same: &[&Group],
    binder: &Binder,
    course: &[Seen],
    (mechanism, sweep, points): (&Mechanism, &Sweep, &[PointId]),
) -> Option<(Group, Frame)> {
    let number = item.data.iter().find(|(name, _)| *name == "link").map(|(_, of)| of.as_str());
    let named = |link: &LinkId| number == Some(mechanism.link(*link).number.to_string().as_str());
    let link = mechanism.moving().find(|link| item.class.starts_with("link") && named(link))?;
    let frame = match frame_of_link(sweep, link, points) {
        Frame::At(place) => Frame::Headed(place, scalar(sweep, Quantity::Angle(link))?),
        Frame::Rigid(a, b) => Frame::Rigid(a, b),
        _ => return None,
    };
    let (home, riders) = (binder.seen.first()?, riders(mechanism, link));
    let mut own = item.clone();
    if !item.class.contains("slot") || riders.is_empty() {
        return Some((own, frame));
    }
    // Along the longest stroke.
    let mut along: Option<Vec2> = None;
    item.walk(&mut |node| {
        if let Node::Mark(mark) = node {
            for (a, b) in mark.shape.outline() {
                let (Some(a), Some(b)) = (frame.local(a, home), frame.local(b, home)) else { continue };
                if along.is_none_or(|known| known.hypot() < (b - a).hypot()) {
                    along = Some(b - a);
                }
            }
        }
    });
    let along = along.filter(|along| along.hypot() > 1.0)?.normalize();
    let way = |at: Point, seen: &Seen| frame.local(at, seen).map(|own| own.dot(along));
    let reach = |group: &Group, seen: &Seen| {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        group.walk(&mut |node| {
            if let Node::Mark(Mark { shape: Shape::Polygon(points), .. }) = node
                && points.len() == 4
            {
                for at in points.iter().filter_map(|at| way(*at, seen)) {
                    (low, high) = (low.min(at), high.max(at));
                }
            }
        });
        (low, high)
    };
    let (low, high) = reach(item, home);
    if low >= high {
        return Some((own, frame));
    }
    let (mut least, mut most) = (low, high);
    for (group, seen) in same.iter().zip(&binder.seen) {
        let (low, high) = reach(group, seen);
        (least, most) = (least.min(low), most.max(high));
    }
    for rider in riders {
        let Some(place) = points.iter().position(|point| *point == rider) else { continue };
        for at in course.iter().filter_map(|seen| way(seen.at(place)?, seen)).filter(|at| at.abs() < 1e3) {
            (least, most) = (least.min(at - BEYOND), most.max(at + BEYOND));
        }
    }
    let middle = f64::midpoint(low, high);
    let stretched = |at: Point| {
        let Some(own) = frame.local(at, home) else { return at };
        let by = if own.dot(along) > middle { most - high } else { least - low };
        frame.global(own + along * by, home).unwrap_or(at)
    };
    let mut all = Group { children: Vec::new(), ..item.clone() };
    item.walk(&mut |node| {
        let Node::Mark(mark) = node else { return };
        let shape = match &mark.shape {
            Shape::Line(a, b) => Shape::Line(stretched(*a), stretched(*b)),
            Shape::Polygon(points) => Shape::Polygon(points.iter().map(|at| stretched(*at)).collect()),
            Shape::Polyline(points) => Shape::Polyline(points.iter().map(|at| stretched(*at)).collect()),
            other => other.clone(),
        };
        all.mark(Mark { shape, ..mark.clone() });
    });
    own = all;
    Some((own, frame))
}

/// A slot ends so far beyond its rider, mm.
const BEYOND: f64 = 5.0;

/// The points that ride in the slots of a link.
fn riders(mechanism: &Mechanism, link: LinkId) -> Vec<PointId> {
    let own = mechanism.slides.iter().filter(|slide| slide.guide.link == link);
    own.filter_map(|slide| match slide.rider {
        Rider::Pin { point, .. } => Some(point),
        Rider::Link { link, .. } => mechanism.link(link).points.first().copied(),
    })
    .collect()
}

/// The links that are driven at a stated angle: of each the sheet draws the angle, in this order.
fn inputs_with_an_angle(mechanism: &Mechanism) -> impl Iterator<Item = LinkId> + '_ {
    mechanism.inputs.iter().filter_map(|input| match *input {
        Input::Angle { link, angle: Some(_), .. } | Input::Speed { link, angle: Some(_), .. } => Some(link),
        _ => None,
    })
}

/// The arc of an angle from the right, as it is drawn in the first position in which the angle is not zero, and what stands still
/// beside it.
fn turns(same: &[&Group], binder: &Binder) -> Vec<(Group, Move)> {
    let is_line = |mark: &&&Mark| matches!(mark.shape, Shape::Line(..));
    let mut still = Group::new("axis");
    for mark in same.first().iter().flat_map(|own| marks(own)).filter(|mark| is_line(&mark)) {
        still.mark(mark.clone());
    }
    let mut all = vec![(still, Move::Whole(Frame::Fixed))];
    let arc = |(own, seen): (&&Group, &Seen)| {
        let (centre, radius) = marks(own).into_iter().find_map(|mark| match mark.shape {
            Shape::Arc { centre, radius, .. } => Some((centre, radius)),
            _ => None,
        })?;
        let is_here = |at: &Option<Point>| at.is_some_and(|at| at.distance(centre) < 1e-4);
        let place = seen.places.iter().position(is_here)?;
        let mut group = Group::new("turn");
        marks(own).into_iter().filter(|mark| !is_line(&mark)).for_each(|mark| group.mark(mark.clone()));
        Some((group, Move::Turn(place, radius, None)))
    };
    all.extend(same.iter().zip(&binder.seen).find_map(arc));
    all
}

/// A curved arrow the other way round.
fn mirrored(item: &Group) -> Group {
    let mut axis = None;
    item.walk(&mut |node| {
        if let Node::Mark(Mark { shape: Shape::Arc { centre, start, sweep, .. }, .. }) = node {
            axis.get_or_insert((*centre, start + sweep / 2.0));
        }
    });
    let Some((centre, middle)) = axis else { return item.clone() };
    let (sin, cos) = libm::sincos(2.0 * middle);
    // About the axis at `middle` through the centre, y down.
    let flip = |at: Point| {
        let d = at - centre;
        centre + Vec2::new(d.x * cos - d.y * sin, -d.x * sin - d.y * cos)
    };
    let mut group = Group { children: Vec::new(), ..item.clone() };
    item.walk(&mut |node| {
        let Node::Mark(mark) = node else { return };
        let shape = match &mark.shape {
            Shape::Arc { centre, radius, start, sweep } => {
                Shape::Arc { centre: *centre, radius: *radius, start: 2.0 * middle - start, sweep: -sweep }
            }
            Shape::Polygon(points) => Shape::Polygon(points.iter().map(|at| flip(*at)).collect()),
            other => other.clone(),
        };
        group.mark(Mark { shape, ..mark.clone() });
    });
    group
}

/// The first straight stroke of some length.
fn straight(item: &Group) -> Option<(Point, Point)> {
    let mut line = None;
    item.walk(&mut |node| {
        if let Node::Mark(Mark { shape: Shape::Line(a, b), .. }) = node {
            line.get_or_insert((*a, *b));
        }
    });
    line.filter(|(a, b)| a.distance(*b) > 1.0)
}

/// The place that moves and stands across the middle of a straight guide as it is drawn.
fn rider_on(item: &Group, binder: &Binder) -> Option<usize> {
    /// A guide lies no farther from the middle of its block, mm.
    const ACROSS: f64 = 8.0;
    let (a, b) = straight(item)?;
    let (middle, along) = (a.midpoint(b), (b - a).normalize());
    let (home, others) = binder.seen.split_first()?;
    (0..home.places.len()).find(|place| {
        let Some(at) = home.at(*place) else { return false };
        let off = at - middle;
        let goes = others.iter().filter_map(|seen| seen.at(*place)).any(|now| now.distance(at) > 1e-3);
        goes && off.dot(along).abs() < 1e-3 && off.cross(along).abs() < ACROSS
    })
}

/// The ground that a wheel rolls on with its hatching, and what is not ground: only the frame is hatched.
fn ground_of(item: &Group) -> Option<(Group, Group)> {
    let part = |wanted: bool| {
        let mut own = Group { children: Vec::new(), ..item.clone() };
        item.walk(&mut |node| {
            if let Node::Mark(mark) = node
                && matches!(mark.class, "rack" | "hatch") == wanted
            {
                own.mark(mark.clone());
            }
        });
        own
    };
    let has = |class: &str| marks(item).iter().any(|mark| mark.class == class);
    (has("rack") && has("hatch") && straight(&part(true)).is_some()).then(|| (part(true), part(false)))
}

/// A guide as far as its rider goes: copies one beside the other, each as long as it is drawn.
fn along_the_course(item: &Group, rider: usize, course: &[Seen], binder: &Binder) -> Vec<Group> {
    let Some(start) = binder.seen.first().and_then(|seen| seen.at(rider)) else {
        return vec![item.clone()];
    };
    let Some((a, b)) = straight(item) else { return vec![item.clone()] };
    let (length, along) = (a.distance(b), (b - a).normalize());
    let way = |seen: &Seen| seen.at(rider).map(|at| (at - start).dot(along)).filter(|way| way.abs() < 1e3);
    let (low, high) =
        course.iter().filter_map(way).fold((0.0_f64, 0.0_f64), |(l, h), w| (l.min(w), h.max(w)));
    let mut at = low;
    let mut copies = Vec::new();
    loop {
        let mut copy = item.clone();
        copy.translate(along * at);
        copies.push(copy);
        if at >= high {
            return copies;
        }
        at += length;
    }
}

/// The images at which a construction line begins and which it helped to find, by place. Where they are tells, in all polygons
/// that have the line: at the scene's own position, of the first one, others may fall on them.
fn ends_of_line(number: usize, polygons: &[&Diagram], labels: &[Label]) -> Option<[usize; 2]> {
    let told = |line: &ConstructionLine| match line {
        ConstructionLine::Ray { from, to, claim, step } => Some(((*claim, *step), [*from, *to])),
        ConstructionLine::Arc { .. } => None,
    };
    let lines = &polygons.first()?.lines;
    let (key, _) = told(lines.get(number)?)?;
    let alike = |line: &&ConstructionLine| told(line).is_some_and(|(other, _)| other == key);
    let rank = lines[..number].iter().filter(alike).count();
    let ends = |polygon: &&Diagram| Some(told(polygon.lines.iter().filter(alike).nth(rank)?)?.1);
    let of_all: Vec<(&Diagram, [[f64; 2]; 2])> =
        polygons.iter().filter_map(|polygon| Some((*polygon, ends(polygon)?))).collect();
    let stands = |polygon: &Diagram, label: Label| match polygon.images.iter().find(|own| own.label == label)
    {
        Some(image) => Some(image.at),
        None => (label == Label::Pole).then_some([0.0; 2]),
    };
    let is_end = |end: usize, label: Label| {
        let mut met = of_all.iter().map(|(polygon, ends)| {
            stands(polygon, label).map(|at| libm::hypot(at[0] - ends[end][0], at[1] - ends[end][1]) < 1e-9)
        });
        met.next() == Some(Some(true)) && met.all(|met| met != Some(false))
    };
    let [from, to] = [0, 1].map(|end| labels.iter().position(|label| is_end(end, *label)));
    Some([from?, to?])
}

fn polygon_ink(
    panel: &mut Panel,
    index: usize,
    diagram: &Drawing,
    polygons: &[&Diagram],
    labels: &[Label],
    names: &Names,
) {
    let Some(polygon) = polygons.first() else { return };
    let place = |label: Label| labels.iter().position(|own| *own == label);
    for node in &diagram.ink.children {
        let Node::Group(own) = node else { continue };
        let mut own = own.clone();
        let told =
            own.id.as_deref().and_then(|id| Some((id.chars().next()?, id.get(1..)?.parse::<usize>().ok()?)));
        let Some((kind, number)) = told else {
            panel.ink.group(own);
            continue;
        };
        // A link's own point, not that of another link under it: the one where the corner stands.
        let image = |&(point, at): &(PointId, [f64; 2])| {
            let own = |image: &&Image| {
                matches!(image.label, Label::Image { point: of, .. } if of == point) && image.at == at
            };
            match polygon.images.iter().find(own) {
                Some(image) => place(image.label),
                // A fixed point has no image but the pole.
                None => place(Label::Pole).filter(|_| at == [0.0; 2]),
            }
        };
        let by = match kind {
            'v' => {
                polygon.vectors.get(number).and_then(|v| Some(Move::Vector([place(v.tail)?, place(v.head)?])))
            }
            'r' => ends_of_line(number, polygons, labels).map(Move::Ray),
            'p' => polygon.images.get(number).and_then(|i| Some(Move::Whole(Frame::At(place(i.label)?)))),
            'l' => polygon.link_images.get(number).and_then(|image_of| {
                let corners = image_of.corners.iter().map(image);
                Some(Move::Outline(corners.collect::<Option<Vec<_>>>()?))
            }),
            _ => None,
        };
        let quantity = of_kind(&names.quantities, polygon.kind).filter(|_| kind == 'v');
        let quantity = quantity.and_then(|all| all.get(number)).cloned();
        let step = own.life.map(|life| life.born.step);
        let id = format!("d{index}{kind}{number}");
        own.id = Some(id.clone());
        panel.ink.group(own.clone());
        panel.moving.push(Moving {
            id,
            by: by.unwrap_or(Move::Still),
            quantity,
            sense: None,
            step,
            ink: own,
        });
    }
}

impl CurvedArrow {
    /// Whether its middle is here, where it is drawn: not every one that is drawn moves.
    fn is_at(&self, position: usize, at: Point) -> bool {
        /// The head of an arrow takes so much of its arc, mm.
        const HEAD: f64 = 2.5;
        let (drawn, ink) = &self.drawn;
        let is_here = |mark: &&Mark| match mark.shape {
            Shape::Arc { centre, radius, start, sweep } => {
                let middle = crate::sheet::figure::on_circle(centre, radius, start + sweep / 2.0);
                (at.distance(centre) - radius).abs() < 1e-6 && at.distance(middle) < HEAD
            }
            _ => false,
        };
        *drawn == position && marks(ink).iter().any(is_here)
    }
}

/// The names of the curved arrows, each with the position in which its arrow is drawn and its place among the names of that.
fn names_of_arrows(
    own: &[&Drawing],
    binder: &Binder,
    arrows: &[CurvedArrow],
) -> Vec<(usize, usize, Spotted)> {
    let mut all = Vec::new();
    for (position, (drawing, seen)) in own.iter().zip(&binder.seen).enumerate() {
        for (n, name) in drawing.names.iter().enumerate() {
            let at = name.spot().anchor();
            let arrow = arrows.iter().find(|arrow| arrow.is_at(position, at));
            if let Some(arrow) = arrow.filter(|_| name.class() == "label rotation-name")
                && let Some(place) = arrow.frame.local(at, seen)
            {
                let spotted = Spotted::new(name.clone(), vec![(arrow.frame, place)]);
                all.push((position, n, Spotted { output: Some(arrow.output), ..spotted }));
            }
        }
    }
    all
}

/// The names of a skeleton, each with what it hangs on.
fn names_of_skeleton(
    own: &[&Drawing],
    binder: &Binder,
    panel: &Panel,
    arrows: &[CurvedArrow],
) -> Vec<Spotted> {
    let of_arrows = names_of_arrows(own, binder, arrows);
    let mut all = Vec::new();
    for (n, name) in own[0].names.iter().enumerate() {
        let at = |point: Point, frame: Frame| Some((frame, binder.local(frame, point)?));
        let ends = |spot: Spot| match spot {
            Spot::Point(at) => vec![at],
            Spot::Stroke(from, to) => vec![from, to],
        };
        // What an angle says is of one position.
        if name.class() == "label angle" {
            continue;
        }
        if name.class() == "label rotation-name" {
            let of_this = of_arrows.iter().find(|(position, own, _)| (*position, *own) == (0, n));
            all.extend(of_this.map(|(.., spotted)| spotted.clone()));
            continue;
        }
        let first = ends(name.spot());
        let is_of_the_frame = name.class() == "label link-number" && name.of().is_empty();
        let bound: Option<Anchors> = if is_of_the_frame {
            first.iter().map(|point| at(*point, Frame::Fixed)).collect()
        } else {
            // In a crowd an arrow with its name may be given up: names are told by what they say.
            let nth = own[0].names[..n].iter().filter(|before| before.is_like(name)).count();
            let like = |d: &&Drawing| d.names.iter().filter(|other| other.is_like(name)).nth(nth).cloned();
            let several: Vec<Vec<Point>> =
                own.iter().filter_map(like).map(|other| ends(other.spot())).collect();
            let same = several.len() == own.len() && several.iter().all(|points| points.len() == first.len());
            let bind = |i: usize| {
                let points: Vec<Point> = several.iter().map(|points| points[i]).collect();
                binder.frame(&[points]).and_then(|frame| at(first[i], frame))
            };
            let bound: Option<Anchors> = if same { (0..first.len()).map(bind).collect() } else { None };
            // Beside a slot that its pin may leave the number stays with the link.
            match bound {
                Some(bound) if bound.len() > 1 => Some(bound.into_iter().map(|at| panel.held(at)).collect()),
                bound => bound,
            }
        };
        all.extend(bound.map(|bound| Spotted::new(name.clone(), bound)));
    }
    let of_others = of_arrows.into_iter().filter(|(position, ..)| *position > 0);
    all.extend(of_others.map(|(.., spotted)| spotted));
    all
}

fn names_of_polygon(polygon: &Diagram, labels: &[Label], panel: &Panel, names: &Names) -> Vec<Spotted> {
    let place = |label: Label| labels.iter().position(|own| *own == label);
    // A name comes with the ink that it names, and the name of the pole with the first ink of all.
    let born = |wanted: &dyn Fn(char, usize) -> bool| {
        let is_wanted = |moving: &&Moving| {
            let own = moving.id.trim_start_matches('d').trim_start_matches(|c: char| c.is_ascii_digit());
            let mut letters = own.chars();
            let kind = letters.next();
            kind.zip(letters.as_str().parse().ok()).is_some_and(|(kind, number)| wanted(kind, number))
        };
        panel.moving.iter().filter(is_wanted).filter_map(|moving| moving.step).min()
    };
    let pole = born(&|_, _| true);
    let mut all = Vec::new();
    let mut seen: Vec<&Vec<(i8, usize)>> = Vec::new();
    for (labels, name) in of_kind(&names.images, polygon.kind).into_iter().flatten() {
        let Some(at) = labels.first().and_then(|label| place(*label)) else { continue };
        let terms = &panel.places[at].terms;
        // What is always one point has one name.
        if !seen.contains(&terms) {
            seen.push(terms);
            let is_named =
                |n: usize| polygon.images.get(n).is_some_and(|image| labels.contains(&image.label));
            let step = born(&|kind, n| kind == 'p' && is_named(n)).or(pole);
            let anchors = vec![(Frame::At(at), Vec2::ZERO)];
            all.push(Spotted { name: name.clone(), anchors, step, output: None });
        }
    }
    for (vectors, name) in of_kind(&names.vectors, polygon.kind).into_iter().flatten() {
        let Some(vector) = vectors.first().and_then(|index| polygon.vectors.get(*index)) else { continue };
        let (Some(tail), Some(head)) = (place(vector.tail), place(vector.head)) else { continue };
        let anchors = vec![(Frame::At(tail), Vec2::ZERO), (Frame::At(head), Vec2::ZERO)];
        let step = born(&|kind, n| kind == 'v' && vectors.contains(&n));
        all.push(Spotted { name: name.clone(), anchors, step, output: None });
    }
    all
}

/// The part of a stroke within a rectangle; nothing where it runs past.
fn part_within(shown: Rect, from: Point, to: Point) -> Option<(Point, Point)> {
    let (mut begin, mut end) = (0.0_f64, 1.0_f64);
    let along = |way: f64, low: f64, high: f64, begin: &mut f64, end: &mut f64| {
        if way == 0.0 {
            return low <= 0.0 && high >= 0.0;
        }
        let (first, last) = if way > 0.0 { (low / way, high / way) } else { (high / way, low / way) };
        (*begin, *end) = (begin.max(first), end.min(last));
        begin < end
    };
    let way = to - from;
    let is_seen = along(way.x, shown.x0 - from.x, shown.x1 - from.x, &mut begin, &mut end)
        && along(way.y, shown.y0 - from.y, shown.y1 - from.y, &mut begin, &mut end);
    is_seen.then(|| (from + way * begin, from + way * end))
}

fn names_an_arrow(name: &Name) -> bool {
    name.class() == "label vector-name"
}

fn place_names(
    panel: &mut Panel,
    index: usize,
    spots: Vec<Spotted>,
    (course, start): (&[Numbers], &Numbers),
    (cyclic, glide, own): (bool, f64, usize),
    refit: bool,
) {
    let home = panel.seen(start);
    // What is so small beside what it is elsewhere is zero but for rounding, and has no arrow.
    let least = |output: usize| {
        let sizes = course.iter().filter_map(|numbers| numbers[output]).map(f64::abs);
        1e-9 * sizes.filter(|size| size.is_finite()).fold(0.0, f64::max)
    };
    let senses = panel.moving.iter().filter_map(|moving| moving.sense);
    let least: BTreeMap<usize, f64> = senses.map(|(output, _)| (output, least(output))).collect();
    let least = |output: usize| least.get(&output).copied().unwrap_or(0.0);
    let frame = |numbers: &Numbers| {
        let fitted = if refit { panel.fitted(numbers) } else { None };
        let seen = panel.seen_at(numbers, fitted.unwrap_or(panel.si_per_mm));
        let mut ink = Group::new("moved");
        for moving in &panel.moving {
            let visible = moving.sense.is_none_or(|(output, positive)| {
                numbers[output].is_some_and(|value| value.abs() > least(output) && (value > 0.0) == positive)
            });
            if visible && let Some(moved) = moving.moved(&home, &seen) {
                ink.group(moved);
            }
        }
        let spot = |name: &Name, anchors: &[(Frame, Vec2)]| {
            let points: Option<Vec<Point>> =
                anchors.iter().map(|(frame, own)| frame.global(*own, &seen)).collect();
            match points?[..] {
                [at] => Some(Spot::Point(at)).filter(|_| panel.shown.contains(at)),
                [from, to, ..] if !names_an_arrow(name) => Some(Spot::Stroke(from, to)),
                // Next to a limit a vector is metres long: its name stands by what is seen of it.
                [from, to, ..] => part_within(panel.shown, from, to)
                    .filter(|(from, to)| from.distance(*to) >= SHORTEST_NAMED)
                    .map(|(from, to)| Spot::Stroke(from, to)),
                _ => None,
            }
        };
        moving::Frame { ink, spots: spots.iter().map(|own| spot(&own.name, &own.anchors)).collect() }
    };
    let frames: Vec<moving::Frame> = course.iter().map(frame).collect();
    let names: Vec<Name> = spots.iter().map(|own| own.name.clone()).collect();
    // On a skeleton names stand beside what they name.
    let ties = panel.has_ties();
    let along = moving::Course { cyclic, glide, home: own, ties, shown: panel.shown };
    let ways = moving::along(&names, &frames, along);
    let mut labels = Group::new("labels");
    let mut placed = Vec::new();
    for (number, (spot, by)) in spots.into_iter().zip(ways).enumerate() {
        let Spotted { name, anchors, step, output } = spot;
        let id = format!("d{index}n{number}");
        let (mut ink, half) = name.ink();
        ink.id = Some(id.clone());
        labels.group(ink);
        let is_of_point = matches!(name.class(), "label point-name" | "label image-name");
        let is_of_arrow = names_an_arrow(&name) && panel.kind == DiagramKind::Skeleton;
        let of = name.of().to_vec();
        placed.push(Placed { id, anchors, by, half, step, output, of, is_of_point, is_of_arrow });
    }
    panel.ink.group(labels);
    panel.names = placed;
}
