//! Round scales: 1, 2, 2.5, 5 × 10ⁿ.

use std::cell::RefCell;
use std::collections::HashMap;

use kurbo::{Point, Rect, Vec2};

use super::compose::free_paper;
use super::overlap::clip;
use crate::graphical::auxiliary::AuxiliaryDrawing;
use crate::graphical::construction::Construction;
use crate::graphical::{Extents, Scales};
use crate::mechanism::quantity::Dimension;
use crate::mechanism::{Mechanism, PointId, Roll};
use crate::scene::Scene;

/// The round steps within a decade.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// Room for the skeleton's geometry with the result table beside it, width and height in mm.
pub const SKELETON: (f64, f64) = (92.0, 70.0);
/// Room for a long and low skeleton that has the row to itself.
pub const LONG_SKELETON: (f64, f64) = (150.0, 48.0);
/// Room for a construction on the skeleton with its named points, inside the names.
pub const AUXILIARY: (f64, f64) = (140.0, 130.0);
/// Room for a polygon that shares its row with another.
pub const HALF_POLYGON: (f64, f64) = (73.0, 78.0);
/// Room for the only polygon of a sheet, and for arrows on the skeleton.
pub const LONE_POLYGON: (f64, f64) = (150.0, 78.0);
/// Room for a polygon that has the row to itself.
pub const POLYGON: (f64, f64) = (150.0, 108.0);
/// Room for a polygon that has more than half of a page.
pub const HALF_PAGE_POLYGON: (f64, f64) = (158.0, 150.0);
/// Room for a polygon that has a page to itself.
pub const PAGE_POLYGON: (f64, f64) = (158.0, 205.0);
/// Room for a skeleton that has the row to itself.
pub const ROW_SKELETON: (f64, f64) = (150.0, 104.0);
/// Room for a skeleton that has more than half of a page.
pub const HALF_PAGE_SKELETON: (f64, f64) = (155.0, 138.0);
/// Room for a skeleton that has a page to itself.
pub const PAGE_SKELETON: (f64, f64) = (155.0, 180.0);
/// Points of a polygon that are not one stand so far apart on paper, mm, where the paper suffices.
pub const APART: f64 = 3.0;
/// Joints of a skeleton: a shorter link is hidden by the circles of its own pins.
const JOINTS_APART: f64 = 12.0;
/// What a named vector or point needs of a polygon's area, mm², if its name is to stand beside it.
const PER_NAME: f64 = 110.0;
/// Width that two polygons side by side have, with their names, and at least for their captions.
const ROW: f64 = 168.0;
/// Width that the names beside a polygon need.
const NAMES: f64 = 13.0;
/// Height of a page beside a diagram's points: headings, names and the caption.
const AROUND_DRAWN: f64 = 58.0;
/// Width of a caption.
const CAPTION: f64 = 70.0;

/// Room for the skeleton of a question with its dimension lines, width and height in mm.
pub const QUESTION: (f64, f64) = (112.0, 96.0);

/// The scales of a question: as for a solution, but the skeleton has the row to itself.
#[must_use]
pub fn for_question(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (QUESTION.0 * wide, QUESTION.1 * high);
    let stated = scene.sheet.length_scale.map(|ratio| ratio / 1000.0);
    let length = stated.or(choose_length(w, h, free)).unwrap_or(0.001);
    for_scene(scene, extents).with(Dimension::Length, length)
}

/// Room for a diagram beside the words of a step, width and height in mm.
pub const STEP: (f64, f64) = (66.0, 62.0);

/// The scales of a sheet that shows the steps one by one: each diagram fits beside its words.
#[must_use]
pub fn for_steps(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let free = (STEP.0 * wide, STEP.1 * high);
    let fit = |dimension: Dimension, [w, h]: [f64; 2]| match dimension {
        Dimension::Length => choose_length(w, h, free),
        _ => choose_for(w, h, free, unit(scene, dimension)),
    };
    Scales::new(|dimension| {
        let size = match dimension {
            Dimension::Length => Some([w, h]),
            _ => largest(&extents, dimension),
        };
        let fitting = || size.and_then(|size| fit(dimension, size));
        stated(scene, dimension).or_else(fitting).unwrap_or(by_default(scene, dimension))
    })
}

/// The scale of a dimension that a scene states, SI per mm.
fn stated(scene: &Scene, dimension: Dimension) -> Option<f64> {
    match dimension {
        Dimension::Length => scene.sheet.length_scale.map(|ratio| ratio / 1000.0),
        Dimension::Velocity => scene.sheet.velocity_scale,
        Dimension::Acceleration => scene.sheet.acceleration_scale,
    }
}

/// One of the scene's units of a dimension, SI.
fn unit(scene: &Scene, dimension: Dimension) -> f64 {
    let (length, time) = (scene.units.length.si, scene.units.time.si);
    match dimension {
        Dimension::Length => length,
        Dimension::Velocity => length / time,
        Dimension::Acceleration => length / (time * time),
    }
}

/// The scale of what has no size: the skeleton in its own, one of the scene's units a millimetre elsewhere.
fn by_default(scene: &Scene, dimension: Dimension) -> f64 {
    match dimension {
        Dimension::Length => 0.001,
        _ => unit(scene, dimension),
    }
}

/// Width and height of all diagrams of a dimension; none where there is no such diagram.
fn largest(extents: &Extents, dimension: Dimension) -> Option<[f64; 2]> {
    let all = extents.diagrams.iter().filter(|extent| extent.kind.dimension() == dimension);
    all.map(|extent| extent.size).reduce(|a, b| [0, 1].map(|axis| a[axis].max(b[axis])))
}

/// How much wider and higher than those of upright A4 the panels are.
pub(super) fn stretch(scene: &Scene) -> (f64, f64) {
    let (width, height) = free_paper(scene);
    let (wide, high) = (width / 176.0, height / 263.0);
    (wide, high.max((wide * high).sqrt()).min(height / 120.0))
}

/// The scales of a scene: those that it states, else round ones by which the diagrams fill their panels. A diagram whose
/// points crowd has a row, then a page to itself, and so has one for which the pages have room.
#[must_use]
pub fn for_scene(scene: &Scene, extents: Extents) -> Scales {
    let skeleton = Choice {
        dimension: Dimension::Length,
        size: with_wheels(&scene.mechanism, extents.positions, extents.rims),
        unit: scene.units.length.si,
        stated: stated(scene, Dimension::Length),
        points: &extents.joints,
        vectors: &[],
    };
    let diagrams = extents.diagrams.iter().map(|extent| {
        let dimension = extent.kind.dimension();
        Choice {
            dimension,
            size: extent.size,
            unit: unit(scene, dimension),
            stated: stated(scene, dimension),
            points: &extent.points,
            vectors: &extent.vectors,
        }
    });
    let choices = Choices {
        all: [skeleton].into_iter().chain(diagrams).collect(),
        stretch: stretch(scene),
        paper: free_paper(scene),
        extents: &extents,
        asked: scene.mechanism.asked.len(),
        known: RefCell::default(),
    };
    let best = choices.best();
    Scales::new(|dimension| {
        let of = choices.all.iter().zip(&best).filter(|(choice, _)| choice.dimension == dimension);
        let chosen = of.filter_map(|(_, scale)| *scale).reduce(f64::max);
        chosen.or(stated(scene, dimension)).unwrap_or(by_default(scene, dimension))
    })
}

/// How much room a diagram has.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Room {
    Shared,
    Row,
    Half,
    Page,
}

impl Room {
    const ALL: [Self; 4] = [Self::Shared, Self::Row, Self::Half, Self::Page];
}

/// A diagram whose scale is to be chosen.
struct Choice<'a> {
    dimension: Dimension,
    /// Width and height, SI.
    size: [f64; 2],
    /// One of the scene's units, SI.
    unit: f64,
    /// What the scene states, SI per mm.
    stated: Option<f64>,
    /// Its points, SI; of arrows on the skeleton, which are no diagram, none.
    points: &'a [[f64; 2]],
    /// Its vectors from tail to head, SI.
    vectors: &'a [[[f64; 2]; 2]],
}

/// What the scales of all diagrams are chosen by.
struct Choices<'a> {
    /// The skeleton, then the vector diagrams in their order.
    all: Vec<Choice<'a>>,
    stretch: (f64, f64),
    /// Within the margins, mm.
    paper: (f64, f64),
    extents: &'a Extents,
    /// How many results there are.
    asked: usize,
    /// How many names find no room, by diagram and bits of its scale.
    known: RefCell<HashMap<(usize, u64), usize>>,
}

/// Scales of all diagrams, SI per mm; none where nothing has a size.
type Chosen = Vec<Option<f64>>;

impl Choices<'_> {
    /// The scales at which what crowds has room, and beyond these the largest for which the sheet needs no further page;
    /// then larger ones on the same pages where names found no room or a diagram is small.
    fn best(&self) -> Chosen {
        /// What a name that finds no room, or a diagram that is too small, weighs against millimetres of size.
        const LACK: f64 = 25.0;
        /// Estimates of heights err by about so much, mm.
        const SPARE: f64 = 22.0;
        /// What cannot be read is worth trying: the lines of steps can stand nearer to each other, where these are few.
        const TIGHTER: f64 = -8.0;
        const FEW: usize = 2;
        let count = self.all.len();
        let mut rooms = vec![Room::Shared; count];
        for i in 0..count {
            let mut least = self.crowding(i, self.scales(&rooms)[i]);
            for room in [Room::Row, Room::Page] {
                let mut wider = rooms.clone();
                wider[i] = room;
                let crowding = self.crowding(i, self.scales(&wider)[i]);
                if crowding < least {
                    (rooms, least) = (wider, crowding);
                }
            }
        }
        let pages = self.pages(&self.scales(&rooms), 0.0);
        let size = |scales: &Chosen| (0..count).map(|i| self.gain(i, scales[i])).sum::<f64>();
        let first_of_largest = |ways: Vec<Chosen>, worth: &dyn Fn(&Chosen) -> f64| {
            ways.into_iter().reduce(|best, way| if worth(&way) > worth(&best) { way } else { best })
        };
        let mut ways = self.wider(&rooms, |_| false);
        ways.retain(|scales| self.pages(scales, SPARE) <= pages);
        let roomy = first_of_largest(ways, &size).unwrap_or_else(|| self.scales(&rooms));
        let lacking = self.lack(&roomy);
        if lacking == 0 {
            return roomy;
        }
        let spare = if pages <= FEW { TIGHTER } else { 0.0 };
        let mut ways = self.wider(&rooms, |i| self.nameless(i, roomy[i]) > 0);
        ways.retain(|scales| {
            let smaller = scales.iter().zip(&roomy).any(|(new, old)| new > old);
            !smaller && self.lack(scales) < lacking && self.pages(scales, spare) <= pages
        });
        first_of_largest(ways, &|scales| size(scales) - LACK * self.lack(scales) as f64).unwrap_or(roomy)
    }

    /// All ways of giving diagrams the room that they have, or more: to fill a page a row is enough, but for what may have
    /// a page to itself.
    fn wider(&self, rooms: &[Room], may_have_a_page: impl Fn(usize) -> bool) -> Vec<Chosen> {
        let mut ways: Vec<Vec<Room>> = vec![Vec::new()];
        for (i, &own) in rooms.iter().enumerate() {
            let most = if may_have_a_page(i) { Room::Page } else { Room::Row.max(own) };
            let larger = Room::ALL.into_iter().filter(|room| *room >= own && *room <= most);
            let larger: Vec<Room> = larger.collect();
            ways = ways
                .into_iter()
                .flat_map(|way| larger.iter().map(move |room| [&way[..], &[*room]].concat()))
                .collect();
        }
        ways.iter().map(|way| self.scales(way)).collect()
    }

    /// How large a diagram is to the eye: what fills a quarter of a page is large enough.
    fn gain(&self, i: usize, scale: Option<f64>) -> f64 {
        let Some(scale) = scale else { return 0.0 };
        let [w, h] = self.all[i].size.map(|side| side / scale);
        (w * h).sqrt().max(0.6 * w.max(h)).min(self.enough())
    }

    /// What fills a quarter of upright A4; on a larger page it is larger.
    fn enough(&self) -> f64 {
        let (wide, high) = self.stretch;
        115.0 * (wide * high).sqrt().max(1.0)
    }

    /// How many names find no room, and how many diagrams are too small for their page.
    fn lack(&self, scales: &[Option<f64>]) -> usize {
        /// Part of what is large enough.
        const SMALL: f64 = 0.35;
        let small = |i: usize| scales[i].is_some() && self.gain(i, scales[i]) < SMALL * self.enough();
        (0..self.all.len()).map(|i| self.nameless(i, scales[i]) + usize::from(small(i))).sum()
    }

    /// How many names of a diagram find no room beside what they name.
    fn nameless(&self, i: usize, scale: Option<f64>) -> usize {
        /// Where there are more nobody reads them one by one.
        const MOST: usize = 300;
        let choice = &self.all[i];
        let Some(scale) = scale.filter(|_| choice.vectors.len() <= MOST) else { return 0 };
        // Most ways of giving room lead to the same few scales.
        let key = (i, scale.to_bits());
        if let Some(known) = self.known.borrow().get(&key) {
            return *known;
        }
        let paper = |at: &[f64; 2]| Point::new(at[0] / scale, at[1] / scale);
        let points: Vec<Point> = choice.points.iter().map(paper).collect();
        let vectors: Vec<(Point, Point)> =
            choice.vectors.iter().map(|[from, to]| (paper(from), paper(to))).collect();
        // The names of a skeleton have the whole page about it.
        let without = if i == 0 { 0 } else { names_without_room(&points, &vectors) };
        self.known.borrow_mut().insert(key, without);
        without
    }

    fn scales(&self, rooms: &[Room]) -> Chosen {
        let stretched = |room: (f64, f64)| (room.0 * self.stretch.0, room.1 * self.stretch.1);
        // Never higher than the page, whatever its form.
        let below = |room: (f64, f64)| (room.0, room.1.min(self.paper.1 - AROUND_DRAWN));
        let [w, h] = self.all[0].size;
        let fit = |room| choose_length(w, h, below(stretched(room)));
        let skeleton = match rooms[0] {
            Room::Shared => fit(SKELETON).zip(fit(LONG_SKELETON)).map(|(a, b)| a.min(b)),
            Room::Row => fit(ROW_SKELETON),
            Room::Half => fit(HALF_PAGE_SKELETON),
            Room::Page => fit(PAGE_SKELETON),
        };
        let mut scales = vec![skeleton];
        for pair in self.all[1..].chunks(2) {
            scales.extend(beside(pair, self.stretch));
        }
        for ((choice, own), room) in self.all.iter().zip(&mut scales).zip(rooms).skip(1) {
            let [w, h] = choice.size;
            let room = match room {
                // Arrows on the skeleton are no diagram.
                _ if choice.points.is_empty() => continue,
                Room::Shared => continue,
                Room::Row => POLYGON,
                Room::Half => HALF_PAGE_POLYGON,
                Room::Page => PAGE_POLYGON,
            };
            let wider = choose_for(w, h, below(stretched(room)), choice.unit);
            *own = own.zip(wider).map(|(a, b)| a.min(b));
        }
        self.all.iter().zip(scales).map(|(choice, scale)| choice.stated.or(scale)).collect()
    }

    /// How many points of a diagram stand too near to others at this scale, and how much area its names lack.
    fn crowding(&self, i: usize, scale: Option<f64>) -> usize {
        let Some(scale) = scale else { return 0 };
        let choice = &self.all[i];
        let apart = if i == 0 { JOINTS_APART } else { APART };
        let near = too_near(choice.points, apart * scale);
        let names = if i == 0 { 0 } else { choice.vectors.len() + choice.points.len() };
        let [w, h] = choice.size.map(|side| side / scale);
        // A flat polygon is named along its sides.
        let area = (w + 16.0) * (h + 16.0);
        let lacking = PER_NAME * names as f64 - area;
        near + (lacking / PER_NAME).max(0.0) as usize
    }

    /// About how many pages the sheet needs at these scales, with so much blank to spare, mm.
    fn pages(&self, scales: &[Option<f64>], spare: f64) -> usize {
        const HEADING: f64 = 28.0;
        /// What names and caption add to the height of a diagram, and to that of a skeleton with its supports.
        const AROUND: [f64; 2] = [25.0, 31.0];
        /// Height of a row of the result table, and of its head and end.
        const RESULT: [f64; 2] = [5.9, 9.0];
        const TALLEST_BESIDE: f64 = 112.0;
        /// Width of the figure of centres, and of the circle diagram.
        const CENTRES: f64 = 176.0;
        /// Width of the result table, and what stands about a skeleton.
        const BESIDE: [f64; 2] = [62.0, 34.0];
        let free = self.paper.1 - 6.0;
        let drawn = |i: usize| i == 0 || !self.all[i].points.is_empty();
        let size = |i: usize| {
            let scale = scales[i].filter(|_| drawn(i))?;
            Some(self.all[i].size.map(|side| side / scale))
        };
        let [w, h] = size(0).unwrap_or_default();
        let table = RESULT[0] * self.asked as f64 + RESULT[1];
        let beside = w + BESIDE[1] + BESIDE[0] <= self.paper.0 && table <= TALLEST_BESIDE;
        let mut blocks = vec![[w + BESIDE[1], h + AROUND[1]]];
        if beside {
            blocks.push([BESIDE[0], table + 6.0]);
        }
        let caption = |w: f64| f64::max(w + 2.0 * NAMES, CAPTION);
        blocks.extend((1..self.all.len()).filter_map(size).map(|[w, h]| [caption(w), h + AROUND[0]]));
        if self.extents.circle {
            blocks.extend([[CENTRES, h + AROUND[1] + 40.0], [CENTRES, 110.0]]);
        }
        // Side by side as far as they fit.
        let mut rows: Vec<f64> = Vec::new();
        let mut used = f64::INFINITY;
        for [width, height] in blocks {
            match rows.last_mut().filter(|_| used + width <= self.paper.0) {
                Some(row) => {
                    *row = row.max(height);
                    used += width;
                }
                None => {
                    rows.push(height);
                    used = width;
                }
            }
        }
        if !beside {
            rows.push(RESULT[0] * (self.asked as f64 / 2.0).ceil() + RESULT[1] + 8.0);
        }
        let told = self.extents.told;
        let lines = 1.2 * told.acts as f64 * 4.9 + 18.0 * told.equations as f64 + 8.5 * told.steps as f64;
        // In two columns, of which the wider ones hold more in a line.
        let mut text = lines * (176.0 / self.paper.0).min(1.0) / 2.0 + spare;
        let (mut pages, mut y) = (1, HEADING);
        for row in rows {
            if y + row > free {
                // A small rest of a page stays blank.
                text -= if free - y > 28.0 { free - y - 8.0 } else { 0.0 };
                pages += 1;
                y = 7.0;
            }
            y += row;
        }
        text = text.max(0.0);
        if y + text > free {
            pages += ((y + text - free) / (free - 7.0)).ceil() as usize;
        }
        pages
    }
}

/// How many points and vectors have no place beside them at which a name is clear of all strokes and other names, mm.
fn names_without_room(points: &[Point], vectors: &[(Point, Point)]) -> usize {
    /// What is nearer than this is one.
    const SAME: f64 = 0.05;
    /// Shorter vectors are not named.
    const SHORTEST: f64 = 3.0;
    /// Size of the name of a point and of a vector.
    const NAME: [(f64, f64); 2] = [(4.0, 4.0), (7.0, 4.4)];
    const GAP: f64 = 0.8;
    let mut strokes: Vec<(Point, Point)> = Vec::new();
    for &(from, to) in vectors.iter().filter(|(from, to)| from.distance(*to) > SAME) {
        let same = |one: Point, other: Point| one.distance(from) < SAME && other.distance(to) < SAME;
        if !strokes.iter().any(|&(a, b)| same(a, b) || same(b, a)) {
            strokes.push((from, to));
        }
    }
    strokes.sort_by(|a, b| a.0.distance(a.1).total_cmp(&b.0.distance(b.1)));
    let mut dots: Vec<Point> = Vec::new();
    for &at in points {
        if !dots.iter().any(|other| other.distance(at) < SAME) {
            dots.push(at);
        }
    }
    let mut taken: Vec<Rect> = Vec::new();
    let mut stands = |places: &mut dyn Iterator<Item = Point>, size: (f64, f64)| {
        let free = |own: &Rect| {
            strokes.iter().all(|(a, b)| clip(*a, *b, *own).is_none())
                && taken.iter().all(|other| !other.overlaps(*own))
        };
        let found = places.map(|at| Rect::from_center_size(at, size)).find(free);
        let stands = found.is_some();
        taken.extend(found);
        stands
    };
    let mut without = 0;
    for at in dots {
        let half = Vec2::new(NAME[0].0 / 2.0 + GAP, NAME[0].1 / 2.0 + GAP);
        let mut around = (0..16).map(|k| {
            let (sin, cos) = libm::sincos(f64::from(k) * std::f64::consts::TAU / 16.0);
            at + Vec2::new(half.x * cos, half.y * sin) * 1.2
        });
        without += usize::from(!stands(&mut around, NAME[0]));
    }
    for &(from, to) in strokes.iter().filter(|(from, to)| from.distance(*to) >= SHORTEST) {
        let along = (to - from).normalize();
        let normal = Vec2::new(-along.y, along.x);
        let reach = (normal.x.abs() * NAME[1].0 + normal.y.abs() * NAME[1].1) / 2.0 + GAP;
        let mut beside = [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8]
            .into_iter()
            .flat_map(|t| [1.0, -1.0].map(|side| from.lerp(to, t) + normal * (side * reach)));
        without += usize::from(!stands(&mut beside, NAME[1]));
    }
    without
}

/// How many points have another nearer than `least` that is not the same point.
fn too_near(points: &[[f64; 2]], least: f64) -> usize {
    let mut sorted = points.to_vec();
    sorted.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let same = least * 1e-3;
    let mut near = vec![false; sorted.len()];
    for i in 0..sorted.len() {
        for j in i + 1..sorted.len() {
            if sorted[j][0] - sorted[i][0] >= least {
                break;
            }
            let apart = libm::hypot(sorted[j][0] - sorted[i][0], sorted[j][1] - sorted[i][1]);
            if apart > same && apart < least {
                (near[i], near[j]) = (true, true);
            }
        }
    }
    near.into_iter().filter(|near| *near).count()
}

/// A smaller length scale, metres per millimetre, at which a construction on the skeleton finds room with all its
/// named points; `None` where it has room, or where the skeleton would become too small to read.
#[must_use]
pub fn for_auxiliary(construction: &Construction, drawing: &AuxiliaryDrawing) -> Option<f64> {
    /// The skeleton is not shrunk by more than this.
    const MOST: f64 = 4.0;
    if drawing.is_lever() {
        return None;
    }
    let named = drawing.points.iter().map(|p| p.at);
    let all: Vec<[f64; 2]> = named.chain(construction.space.places.iter().flatten().copied()).collect();
    let extent = |axis: usize| {
        let least = all.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most = all.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        most - least
    };
    let needed = f64::max(extent(0) / AUXILIARY.0, extent(1) / AUXILIARY.1);
    if !(needed > 1.0 && needed <= MOST) {
        return None;
    }
    choose_length(
        extent(0) * construction.space.metres_per_mm,
        extent(1) * construction.space.metres_per_mm,
        AUXILIARY,
    )
}

/// Width and height of a skeleton with its pitch circles: those about placed centres have room in it, those about moving
/// ones may reach a little beyond it, for there is nothing to read at a rim.
fn with_wheels(mechanism: &Mechanism, [w, h]: [f64; 2], rims: [f64; 2]) -> [f64; 2] {
    const BEYOND: f64 = 1.25;
    let place = |p: PointId| mechanism.points.get(p.0)?.place.exact().map(|at| at.map(|x| x.value));
    let mut wheels: Vec<([f64; 2], f64)> = Vec::new();
    for roll in &mechanism.rolls {
        let circles = match roll {
            Roll::Circles { centres, radii, .. } => [0, 1].map(|i| (centres[i], radii[i].value)).to_vec(),
            Roll::Line { centre, radius, .. } => vec![(*centre, radius.value)],
        };
        wheels.extend(circles.into_iter().filter_map(|(centre, radius)| Some((place(centre)?, radius))));
    }
    let grown = |axis: usize, size: f64| {
        let least = wheels.iter().map(|(at, r)| at[axis] - r).fold(f64::INFINITY, f64::min);
        let most = wheels.iter().map(|(at, r)| at[axis] + r).fold(f64::NEG_INFINITY, f64::max);
        size.max(most - least).max(rims[axis] / BEYOND)
    };
    [grown(0, w), grown(1, h)]
}

/// Scales of the diagrams of one row: each of two fits into its half, and a narrow one leaves its room to the other.
fn beside(row: &[Choice<'_>], (wide, high): (f64, f64)) -> Chosen {
    let stretched = |room: (f64, f64)| (room.0 * wide, room.1 * high);
    let fit = |of: &Choice<'_>, free| choose_for(of.size[0], of.size[1], free, of.unit);
    let half = |of: &Choice<'_>| fit(of, stretched(HALF_POLYGON));
    let [first, second] = row else { return row.iter().map(|of| fit(of, stretched(LONE_POLYGON))).collect() };
    let (Some(a), Some(b)) = (half(first), half(second)) else {
        return row.iter().map(|of| fit(of, stretched(LONE_POLYGON))).collect();
    };
    let wider = |taken: f64| (ROW * wide - f64::max(taken + NAMES, CAPTION) - NAMES, POLYGON.1 * high);
    let b = fit(second, wider(first.size[0] / a)).map_or(b, |scale| scale.min(b));
    let a = fit(first, wider(second.size[0] / b)).map_or(a, |scale| scale.min(a));
    vec![Some(a), Some(b)]
}

/// The smallest round number (1, 2, 2.5, 5 × 10ⁿ) that is not below `least`; `None` unless `least` is
/// positive and finite.
#[must_use]
pub fn round_up(least: f64) -> Option<f64> {
    if !(least > 0.0 && least.is_finite()) {
        return None;
    }
    let mut exponent = libm::floor(libm::log10(least)) as i32 - 1;
    // A product that misses the round number by its last bit must not cost a whole step.
    let enough = least * (1.0 - 1e-12);
    loop {
        for step in STEPS {
            let k = shifted(step, exponent);
            if k >= enough && k > 0.0 {
                return k.is_finite().then_some(k);
            }
        }
        exponent += 1;
        if exponent > 308 {
            return None;
        }
    }
}

/// `step × 10^exponent`, correctly rounded: decimal text is, and so is one operation on two exact numbers.
fn shifted(step: f64, exponent: i32) -> f64 {
    const POWERS: [f64; 23] = [
        1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17,
        1e18, 1e19, 1e20, 1e21, 1e22,
    ];
    // Of the steps those of one and more are exact, and the powers up to the 22nd.
    if let Some(power) = POWERS.get(exponent.unsigned_abs() as usize).filter(|_| step >= 1.0) {
        return if exponent < 0 { step / power } else { step * power };
    }
    format!("{step}e{exponent}").parse().unwrap_or(0.0)
}

/// SI units per millimetre of paper such that `max_si` fits into `free_mm` and one *centimetre* of paper
/// is a round number of the scene's units; `unit_si` is how many SI units one of those is.
#[must_use]
pub fn choose(max_si: f64, free_mm: f64, unit_si: f64) -> Option<f64> {
    let per_cm = round_up(max_si / unit_si / (free_mm / 10.0))?;
    let per_mm = per_cm * unit_si / 10.0;
    (per_mm > 0.0 && per_mm.is_finite()).then_some(per_mm)
}

/// The same for what is `width_si` wide and `height_si` high and must fit into a panel.
#[must_use]
pub fn choose_for(width_si: f64, height_si: f64, free_mm: (f64, f64), unit_si: f64) -> Option<f64> {
    let tall = height_si / free_mm.1 * free_mm.0;
    choose(width_si.max(tall), free_mm.0, unit_si)
}

/// Metres per millimetre of paper such that what is `width_m` wide and `height_m` high fits into a panel
/// and the ratio is 1 : N with a round N (or N : 1 for what is smaller than its drawing).
#[must_use]
pub fn choose_length(width_m: f64, height_m: f64, free_mm: (f64, f64)) -> Option<f64> {
    let needed = (width_m / free_mm.0).max(height_m / free_mm.1) * 1000.0;
    if needed >= 1.0 {
        return Some(round_up(needed)? / 1000.0);
    }
    // Enlarged: N : 1 with the largest round N that still fits.
    let mut enlarge = round_up(1.0 / needed)?;
    if enlarge * needed > 1.0 + 1e-12 {
        let below = STEPS.iter().rev().map(|s| s / 10.0).chain(STEPS.iter().rev().copied());
        let exponent = libm::floor(libm::log10(enlarge)) as i32;
        let mut fitting = 0.0_f64;
        for step in below {
            for e in [exponent, exponent + 1] {
                let n = shifted(step, e);
                if n * needed <= 1.0 + 1e-12 {
                    fitting = fitting.max(n);
                }
            }
        }
        enlarge = fitting;
    }
    (enlarge > 0.0).then(|| 1.0 / (1000.0 * enlarge))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_next_round_number() {
        for (least, round) in [
            (1.0, 1.0),
            (1.01, 2.0),
            (2.0, 2.0),
            (2.1, 2.5),
            (0.3, 0.5),
            (51.0, 100.0),
            (1e-300, 1e-300),
            (7.3e17, 1e18),
        ] {
            assert_eq!(round_up(least), Some(round));
        }
        for none in [0.0, -1.0, f64::NAN, f64::INFINITY, f64::MAX] {
            assert_eq!(round_up(none), None);
        }
    }

    #[test]
    fn the_book_s_scales() {
        // Problem 3-1: V_D = 1.78 m/s fits into 40 mm at 50 cm/s ≡ 1 cm.
        let k = choose(1.782_49, 40.0, 0.01).unwrap();
        assert!((k - 0.05).abs() < 1e-15, "{k}");
        // A 525 by 581 mm mechanism fits into 105 × 66 mm at 1 : 10.
        let k = choose_length(0.525, 0.581, (105.0, 66.0)).unwrap();
        assert!((k - 0.01).abs() < 1e-15, "{k}");
        // A 3 by 2 mm mechanism is enlarged 25 : 1.
        let k = choose_length(0.003, 0.002, (105.0, 66.0)).unwrap();
        assert!((k * 1000.0 * 25.0 - 1.0).abs() < 1e-12, "{k}");
    }
}
