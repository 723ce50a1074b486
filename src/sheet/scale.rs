//! Round scales: 1, 2, 2.5, 5 × 10ⁿ.

use std::cell::RefCell;
use std::collections::HashMap;

use kurbo::{Point, Rect, Vec2};

use super::centres::{self, is_needed, window_over};
use super::compose::{Draft, Filled, free_paper, room_of_question};
use super::figure::{Figure, Node};
use super::overlap::clip;
use super::reach::{self, Window};
use super::transfer;
use crate::graphical::construction::{Centre, CentrePlace, CircleDiagram, Construction, Mm2};
use crate::graphical::{Extents, Scales};
use crate::mechanism::quantity::{Dimension, Method, Quantity};
use crate::mechanism::{LinkId, Mechanism, PointId, Roll};
use crate::scene::Scene;

/// The round steps within a decade.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// Room for the skeleton's geometry with the result table beside it, width and height in mm.
pub const SKELETON: (f64, f64) = (92.0, 70.0);
/// Room for a long and low skeleton that has the row to itself.
pub const LONG_SKELETON: (f64, f64) = (150.0, 48.0);
/// Room for a polygon that shares its row with another.
pub const HALF_POLYGON: (f64, f64) = (73.0, 78.0);
/// Room for the only polygon of a sheet, and for arrows on the skeleton.
pub const LONE_POLYGON: (f64, f64) = (150.0, 78.0);
/// Room for a polygon that has the row to itself.
pub const POLYGON: (f64, f64) = (150.0, 108.0);
/// Room for a polygon that has a page to itself.
pub const PAGE_POLYGON: (f64, f64) = (158.0, 205.0);
/// Room for a skeleton that has a page to itself.
pub const PAGE_SKELETON: (f64, f64) = (155.0, 180.0);
/// Points of a polygon that are not one stand so far apart on paper, mm, where the paper suffices.
pub const APART: f64 = 3.0;
/// Joints of a skeleton: a shorter link is hidden by the circles of its own pins.
const JOINTS_APART: f64 = 12.0;
/// A link of less than this is as good as hidden, and so many times as bad as one that is only short.
const HIDDEN: f64 = 8.0;
const HIDDEN_COUNTS: usize = 2;
/// What a named vector or point needs of a polygon's area, mm², if its name is to stand beside it.
const PER_NAME: f64 = 110.0;
/// Width that two polygons side by side have, with their names, and at least for their captions.
const ROW: f64 = 168.0;
/// Width that the names beside a polygon need.
const NAMES: f64 = 13.0;
/// Height of a page beside a diagram's points: names, the caption and the running title; of the first page the heading besides.
const AROUND_DRAWN: f64 = 30.0;
const HEADING: f64 = 28.0;
/// Height of a page beside a panel with its caption.
const HEADED: f64 = 34.0;
/// Width of a caption.
const CAPTION: f64 = 70.0;
/// Of a mechanism of more links the text fills so many pages that no scale saves one: its scales are chosen without it.
const PAGED: usize = 60;
/// A diagram that is less than this part of what is large enough is too small.
const SMALL: f64 = 0.35;

/// Room for the skeleton of a question with its dimension lines, width and height in mm.
pub const QUESTION: (f64, f64) = (150.0, 150.0);
/// And where the page has more height, as high as this.
const TALL_QUESTION: f64 = 185.0;

/// The scales of a question: as for a solution, but the skeleton has the row to itself.
#[must_use]
pub fn for_question(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let tall = room_of_question(scene).min(TALL_QUESTION * high);
    let free = (QUESTION.0 * wide, (QUESTION.1 * high).max(tall));
    let stated = scene.sheet.length_scale.map(|ratio| ratio / 1000.0);
    let length = stated.or(choose_length(w, h, free)).unwrap_or(0.001);
    for_scene(scene, extents).with(Dimension::Length, length)
}

/// Room for a diagram beside the words of a step, width and height in mm.
pub const STEP: (f64, f64) = (86.0, 108.0);
/// Room for one above the words of a step: two of them fill a page.
pub const STEP_ABOVE: (f64, f64) = (158.0, 105.0);
/// The same of the skeleton, which is no smaller than in the solution.
const SKELETON_ABOVE: (f64, f64) = (158.0, 150.0);

/// The scales of a sheet that shows the steps one by one: those of the solution, so that its drawings are found again, or
/// larger ones where a diagram has the room beside its words; each leaves room for these on its page.
#[must_use]
pub fn for_steps(scene: &Scene, extents: Extents) -> Scales {
    let [w, h] = with_wheels(&scene.mechanism, extents.space, extents.rims);
    let (wide, high) = stretch(scene);
    let fit = |dimension: Dimension, [w, h]: [f64; 2], room: (f64, f64)| {
        let free = (room.0 * wide, room.1 * high);
        match dimension {
            Dimension::Length => choose_length(w, h, free),
            _ => choose_for(w, h, free, unit(scene, dimension)),
        }
    };
    let sizes = Dimension::ALL.map(|dimension| match dimension {
        Dimension::Length => Some([w, h]),
        _ => largest(&extents, dimension),
    });
    let of_solution = for_scene(scene, extents);
    Scales::new(|dimension| {
        let size = sizes[dimension as usize];
        let fitting = || {
            let room = if dimension == Dimension::Length { SKELETON_ABOVE } else { STEP_ABOVE };
            let (beside, above) = (fit(dimension, size?, STEP)?, fit(dimension, size?, room)?);
            Some(of_solution.of(dimension).min(beside).max(above))
        };
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
pub(super) fn unit(scene: &Scene, dimension: Dimension) -> f64 {
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
/// points crowd has a row or a page to itself, and so has one for which the pages have room.
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
    let drawn = extents.drawn.as_ref().filter(|_| scene.mechanism.links.len() <= PAGED);
    let choices = Choices {
        all: [skeleton].into_iter().chain(diagrams).collect(),
        stretch: stretch(scene),
        paper: free_paper(scene),
        draft: drawn.map(|drawn| Draft::of(scene, drawn)),
        others: drawn.map_or_else(Others::default, |drawn| Others::of(scene, drawn, &extents.joints)),
        known: RefCell::default(),
    };
    let best = choices.best();
    Scales::new(|dimension| {
        let of = choices.all.iter().zip(&best).filter(|(choice, _)| choice.dimension == dimension);
        let chosen = of.filter_map(|(_, scale)| *scale).reduce(f64::max);
        chosen.or(stated(scene, dimension)).unwrap_or(by_default(scene, dimension))
    })
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
    /// The text; none where nobody asks for a page.
    draft: Option<Draft>,
    others: Others,
    /// How many names find no room, by diagram and bits of its scale.
    known: RefCell<HashMap<(usize, u64), usize>>,
}

/// What stands on a sheet besides the skeleton and the polygons.
#[derive(Debug, Clone, Default)]
struct Others {
    /// Whether the skeleton has a legend.
    legend: bool,
    /// How many links the circle diagram has; none where there is none.
    circle: Option<usize>,
    /// The instant centres, m from the origin of the joints, and whether each is used, or asked for and not far off.
    centres: Vec<([f64; 2], bool)>,
    /// Of each figure that carries velocities over, what it needs beside the skeleton, m.
    turned: Vec<Vec<[f64; 2]>>,
    /// Whether Klein's construction follows.
    klein: bool,
    /// Whether other constructions or forces follow, of which nothing is known yet.
    more: bool,
}

impl Others {
    fn of(scene: &Scene, drawn: &Construction, joints: &[[f64; 2]]) -> Self {
        let mechanism = &scene.mechanism;
        let point = |[x, y]: &[f64; 2]| Point::new(*x, *y);
        let place = joints.iter().map(|own| Rect::from_points(point(own), point(own)));
        let place = place.reduce(|a, b| a.union(b)).unwrap_or_default();
        let apart = |method: Method| matches!(method, Method::TwoMasses { .. } | Method::Lever);
        let forces = |quantity: Quantity| matches!(quantity, Quantity::Force(..) | Quantity::Cycle(_));
        let metres = |at: Mm2| at.map(|x| x * drawn.space.metres_per_mm);
        let centre = |used: &[[LinkId; 2]], centre: &Centre| match centre.place {
            CentrePlace::At(at) => {
                let at = metres(at);
                Some((at, is_needed(centre, point(&at), place, used, mechanism)))
            }
            CentrePlace::Toward(_) => None,
        };
        let centres = |circle: &CircleDiagram| {
            let used = transfer::used(transfer::acts(circle, drawn));
            circle.centres.iter().filter_map(|own| centre(&used, own)).collect::<Vec<_>>()
        };
        let needed = |circle: &CircleDiagram| {
            let all = transfer::by_method(circle).into_iter();
            all.map(|same| transfer::needed(&same).into_iter().map(metres).collect()).collect::<Vec<_>>()
        };
        Self {
            legend: !scene.sheet.positions.is_empty() || scene.sheet.other_assembly,
            circle: drawn.circle.as_ref().map(|_| mechanism.links.len()),
            centres: drawn.circle.iter().flat_map(centres).collect(),
            turned: drawn.circle.iter().flat_map(needed).collect(),
            klein: mechanism.asked.iter().any(|asked| asked.method == Method::Klein),
            more: mechanism.asked.iter().any(|asked| apart(asked.method) || forces(asked.quantity)),
        }
    }
}

/// Scales of all diagrams, SI per mm; none where nothing has a size.
type Chosen = Vec<Option<f64>>;

impl Choices<'_> {
    /// The scales by which the sheet is worth most: diagrams as large as its pages allow, none of them crowded or small
    /// beside the others, no page for some lines.
    fn best(&self) -> Chosen {
        /// What a diagram half as large as is enough costs, in the measure of all that follows.
        const SIZE: f64 = 55.0;
        /// What one that is e times larger than enough gains.
        const LARGER: f64 = 18.0;
        /// What a name that finds no room, or a diagram that is too small, costs.
        const LACK: f64 = 25.0;
        /// What a point too near to another costs, and a centre that nobody asked for and that goes over the edge.
        const CROWDING: f64 = 12.0;
        /// What a page costs, and a last page with nothing on it.
        const PAGE: f64 = 80.0;
        const WASTE: f64 = 100.0;
        /// A last page so full is no waste.
        const FULL: f64 = 0.5;
        /// Heights are told to so much, mm.
        const SPARE: f64 = 9.0;
        /// The same sheet in the script that takes most room, and how much that counts.
        const LONGER: (f64, f64) = (1.12, 0.4);
        let worth_of = |i: usize, scale: Option<f64>| {
            let enough = self.enough(i);
            let size = self.size(i, scale);
            if size <= 0.0 {
                return 0.0;
            }
            let own =
                if size < enough { SIZE * (1.0 - enough / size) } else { LARGER * libm::log(size / enough) };
            let lack = self.nameless(i, scale) + usize::from(size < SMALL * enough);
            // The figures of centres and of velocities carried over grow with the skeleton, unless they need more of the plane.
            let figures = if i == 0 && self.others.circle.is_some() { 2.0 } else { 1.0 };
            let crowding = self.crowding(i, scale) + if i == 0 { self.over_the_edge(scale) } else { 0 };
            figures * own - LACK * lack as f64 - CROWDING * crowding as f64
        };
        let waste = |filled: Filled| match filled.pages {
            1 => 0.0,
            _ if self.others.more => 0.0,
            _ => (1.0 - filled.last / FULL).max(0.0),
        };
        let mut ways: Vec<(Chosen, f64)> = vec![(Vec::new(), 0.0)];
        for (i, least) in self.least().into_iter().enumerate() {
            // Where it is not known what follows no polygon is larger than its names and points need, and no skeleton, which
            // has the scale of its free bodies and of constructions, than is enough.
            let lacks = |scale: Option<f64>| self.nameless(i, scale) + self.crowding(i, scale);
            let may = |scale: &Option<f64>| {
                let larger = scale.zip(least).is_some_and(|(own, least)| own < least);
                let small = i == 0 && self.size(i, *scale) <= self.enough(i);
                !larger || !self.others.more || small || lacks(*scale) < lacks(least)
            };
            let own = self.around(i, least).into_iter().filter(may);
            let own: Vec<(Option<f64>, f64)> = own.map(|scale| (scale, worth_of(i, scale))).collect();
            let longer = |(way, worth): &(Chosen, f64)| {
                let (way, worth) = (way.clone(), *worth);
                own.iter()
                    .map(move |(scale, more)| ([&way[..], &[*scale]].concat(), worth + more))
                    .collect::<Vec<_>>()
            };
            ways = ways.iter().flat_map(longer).collect();
        }
        // The best ones first: the others are not paged.
        ways.sort_by(|a, b| b.1.total_cmp(&a.1));
        let mut best: Option<(Chosen, f64)> = None;
        for (way, worth) in ways {
            if best.as_ref().is_some_and(|(_, most)| worth - PAGE <= *most) {
                break;
            }
            let Some(filled) = self.filled(&way, 1.0, SPARE) else { return self.least() };
            let longer = self.filled(&way, LONGER.0, SPARE).map_or(0.0, waste);
            let worth = worth - PAGE * filled.pages as f64 - WASTE * (waste(filled) + LONGER.1 * longer);
            if best.as_ref().is_none_or(|(_, most)| worth > *most) {
                best = Some((way, worth));
            }
        }
        best.map_or_else(|| self.least(), |(way, _)| way)
    }

    /// How large a diagram is to the eye, mm.
    fn size(&self, i: usize, scale: Option<f64>) -> f64 {
        let Some(scale) = scale else { return 0.0 };
        let [w, h] = self.all[i].size.map(|side| side / scale);
        (w * h).sqrt().max(0.6 * w.max(h))
    }

    /// How large a diagram is that nobody need strain at, mm: what fills a quarter of upright A4 where it has much on it; on
    /// a larger page it is larger.
    fn enough(&self, i: usize) -> f64 {
        /// Without anything on it, for each joint and for each point or vector, and at the least and the most.
        const BARE: f64 = 0.6;
        const JOINT: f64 = 0.08;
        const NAME: f64 = 0.02;
        const OF_A_QUARTER: [f64; 2] = [0.75, 1.15];
        /// Other positions are so much more.
        const POSITIONS: f64 = 1.5;
        let choice = &self.all[i];
        let (wide, high) = self.stretch;
        let quarter = 115.0 * (wide * high).sqrt().max(1.0);
        let part = match i {
            0 => BARE + JOINT * (choice.points.len() + self.constructed()) as f64,
            _ => BARE + NAME * (choice.points.len() + choice.vectors.len()) as f64,
        };
        let positions = if i == 0 && self.others.legend { POSITIONS } else { 1.0 };
        quarter * part.clamp(OF_A_QUARTER[0], OF_A_QUARTER[1]) * positions
    }

    /// How many instant centres lie where no joint is.
    fn constructed(&self) -> usize {
        let joints = self.all[0].points;
        let near = self.all[0].size[0].max(self.all[0].size[1]) * 1e-3;
        let apart = |at: &[f64; 2]| !joints.iter().any(|j| libm::hypot(j[0] - at[0], j[1] - at[1]) < near);
        self.others.centres.iter().filter(|(at, _)| apart(at)).count()
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

    /// A room on this paper for a diagram, never higher than its page, whatever that is: the skeleton stands on the first one.
    fn room(&self, i: usize, (wide, high): (f64, f64)) -> (f64, f64) {
        let around = AROUND_DRAWN + if i == 0 { HEADING } else { 0.0 };
        (wide * self.stretch.0, (high * self.stretch.1).min(self.paper.1 - around))
    }

    /// The scales at which the skeleton stands beside the results, and two polygons beside each other.
    fn least(&self) -> Chosen {
        let [w, h] = self.all[0].size;
        let fit = |room| choose_length(w, h, self.room(0, room));
        let mut scales = vec![fit(SKELETON).zip(fit(LONG_SKELETON)).map(|(a, b)| a.min(b))];
        for pair in self.all[1..].chunks(2) {
            scales.extend(beside(pair, self.stretch));
        }
        self.all.iter().zip(scales).map(|(choice, scale)| choice.stated.or(scale)).collect()
    }

    /// This scale of a diagram, the next smaller one, and all at which it is larger, as far as a page takes it.
    fn around(&self, i: usize, least: Option<f64>) -> Vec<Option<f64>> {
        /// No diagram is made smaller than this part of what is enough to save a page.
        const LEAST: f64 = 0.4;
        let choice = &self.all[i];
        let [w, h] = choice.size;
        let most = match i {
            0 => choose_length(w, h, self.room(0, PAGE_SKELETON)),
            _ => choose_for(w, h, self.room(i, PAGE_POLYGON), choice.unit),
        };
        let mut all = vec![least];
        // Arrows on the skeleton are no diagram.
        let fixed = choice.stated.is_some() || (i > 0 && choice.points.is_empty());
        let (Some(mut scale), Some(most)) = (least, most.filter(|_| !fixed)) else { return all };
        let per = if i == 0 { 0.001 } else { choice.unit / 10.0 };
        // One that is a little smaller may save a page.
        let follows =
            |own: f64| round_below(own / per, i == 0).is_some_and(|x| (x * per / scale - 1.0).abs() < 1e-9);
        let smaller = [1.25, 2.0].into_iter().map(|by| scale * by);
        let large = |own: &f64| self.size(i, Some(*own)) > LEAST * self.enough(i);
        let own = smaller.filter(|own| is_round(own / per, i == 0)).find(|own| follows(*own));
        all.extend(own.filter(large).map(Some));
        while let Some(next) = round_below(scale / per, i == 0).map(|next| next * per)
            && next > most * (1.0 - 1e-9)
        {
            all.push(Some(next));
            scale = next;
        }
        all
    }

    /// How many points of a diagram stand too near to others at this scale, and how much area its names lack.
    fn crowding(&self, i: usize, scale: Option<f64>) -> usize {
        let Some(scale) = scale else { return 0 };
        let choice = &self.all[i];
        let apart = if i == 0 { JOINTS_APART } else { APART };
        let near = too_near(choice.points, apart * scale);
        // Of a link that is hardly seen nobody can measure anything.
        let hidden = if i == 0 { HIDDEN_COUNTS * too_near(choice.points, HIDDEN * scale) } else { 0 };
        let names = if i == 0 { 0 } else { choice.vectors.len() + choice.points.len() };
        let [w, h] = choice.size.map(|side| side / scale);
        // A flat polygon is named along its sides.
        let area = (w + 16.0) * (h + 16.0);
        let lacking = PER_NAME * names as f64 - area;
        near + hidden + (lacking / PER_NAME).max(0.0) as usize
    }

    /// The skeleton's ink at a scale, about.
    fn skeleton(&self, scale: f64) -> Rect {
        /// What supports and names add on each side.
        const AROUND: f64 = 7.0;
        let on_paper = self.all[0].points.iter().map(|at| Point::new(at[0] / scale, at[1] / scale));
        let joints =
            on_paper.map(|at| Rect::from_points(at, at)).reduce(|a, b| a.union(b)).unwrap_or_default();
        let [w, h] = self.all[0].size.map(|side| side / scale);
        joints.union(Rect::from_center_size(joints.center(), (w, h))).inflate(AROUND, AROUND)
    }

    /// What the figure of centres shows of the plane where the skeleton has a scale, and the scale of the figure.
    fn window_of_centres(&self, skeleton: f64) -> (Rect, f64) {
        self.own_scale(skeleton, |scale| {
            let centres: Vec<(Point, bool)> = self
                .others
                .centres
                .iter()
                .map(|(at, asked)| (Point::new(at[0] / scale, at[1] / scale), *asked))
                .collect();
            window_over(self.skeleton(scale), &centres, self.paper)
        })
    }

    /// What the figures that carry velocities over show of it.
    fn windows_of_turning(&self, skeleton: f64) -> Vec<Rect> {
        let window = |needed: &Vec<[f64; 2]>| {
            let (window, _) = self.own_scale(skeleton, |scale| {
                let needed: Vec<Point> =
                    needed.iter().map(|at| Point::new(at[0] / scale, at[1] / scale)).collect();
                let start = self.skeleton(scale).inflate(transfer::BORDER, transfer::BORDER);
                transfer::window_over(start, &needed, Vec::new(), self.stretch)
            });
            window
        };
        self.others.turned.iter().map(window).collect()
    }

    /// A window at the scale that its figure has where the skeleton has this one.
    fn own_scale(&self, skeleton: f64, window: impl Fn(f64) -> Window) -> (Rect, f64) {
        let of = |scale: f64| {
            let window = window(scale);
            ((window.shows, scale), window.lost)
        };
        if self.all[0].stated.is_some() {
            return of(skeleton).0;
        }
        let [w, h] = self.all[0].size;
        reach::chosen(skeleton, (w.max(h) / skeleton, reach::LEAST), of)
    }

    /// How many centres that nobody needs go over the edge of their figure.
    fn over_the_edge(&self, scale: Option<f64>) -> usize {
        let Some(scale) = scale else { return 0 };
        let (window, scale) = self.window_of_centres(scale);
        let outside = |at: &[f64; 2]| !window.contains(Point::new(at[0] / scale, at[1] / scale));
        self.others.centres.iter().filter(|(at, needed)| !needed && outside(at)).count()
    }

    /// How the pages fill at these scales where the text is so much longer, with so much blank to spare, mm.
    fn filled(&self, scales: &[Option<f64>], longer: f64, spare: f64) -> Option<Filled> {
        /// What supports, names and caption add to a skeleton's width and height.
        const SKELETON: [f64; 2] = [14.0, 25.0];
        const LEGEND: f64 = 7.0;
        /// What names and caption add to those of a polygon.
        const POLYGON: [f64; 2] = [11.0, 17.0];
        /// What a detail adds to its height.
        const DETAIL: f64 = 8.0;
        /// Height of a circle diagram with its steps, of up to five links and of more.
        const CIRCLE: [f64; 2] = [86.0, 112.0];
        /// What Klein's circles add to the height, of the width, and the height of what is told of them.
        const KLEIN: f64 = 0.5;
        const KLEIN_TEXT: f64 = 115.0;
        let draft = self.draft.as_ref()?;
        let drawn = |i: usize| i == 0 || !self.all[i].points.is_empty();
        let size = |i: usize| {
            let scale = scales[i].filter(|_| drawn(i))?;
            Some(self.all[i].size.map(|side| side / scale))
        };
        let [w, h] = size(0).unwrap_or_default();
        let others = &self.others;
        let legend = if others.legend { LEGEND } else { 0.0 };
        let wide = (w + SKELETON[0]).max(CAPTION);
        let mut blocks = vec![[wide, h + SKELETON[1] + legend]];
        blocks.extend((1..self.all.len()).filter_map(|i| {
            let [w, h] = size(i)?;
            let detail = if self.crowding(i, scales[i]) > 0 { DETAIL } else { 0.0 };
            Some([(w + POLYGON[0]).max(CAPTION), h + POLYGON[1] + detail])
        }));
        if let Some(links) = others.circle {
            let figure = |window: Rect| [window.width().max(CAPTION), window.height() + centres::AROUND.1];
            let scale = scales[0];
            blocks.extend(scale.map(|scale| figure(self.window_of_centres(scale).0)));
            blocks.push([self.paper.0.min(150.0), CIRCLE[usize::from(links > 5)]]);
            blocks.extend(scale.iter().flat_map(|scale| self.windows_of_turning(*scale)).map(figure));
        }
        if others.klein {
            blocks.push([wide, h + SKELETON[1] + KLEIN * w]);
        }
        let text = if others.klein { KLEIN_TEXT } else { 0.0 };
        Some(draft.filled(&blocks, (longer, text), spare))
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

/// How large the largest diagram is, as far as it is drawn to a scale of the page or to one that the scene states, mm; of a
/// question the skeleton.
#[must_use]
pub fn largest_diagram(scene: &Scene, construction: &Construction, question: bool) -> f64 {
    let across = |points: &mut dyn Iterator<Item = [f64; 2]>| {
        let (mut least, mut most) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
        for at in points {
            for axis in [0, 1] {
                (least[axis], most[axis]) = (least[axis].min(at[axis]), most[axis].max(at[axis]));
            }
        }
        f64::max(most[0] - least[0], most[1] - least[1])
    };
    let mut sizes = vec![across(&mut construction.space.places.iter().flatten().copied())];
    if !question {
        for diagram in &construction.diagrams {
            let ends = diagram.vectors.iter().flat_map(|vector| [vector.from, vector.to]);
            sizes.push(across(&mut ends.chain(diagram.images.iter().map(|image| image.at))));
        }
        if let (Some(forces), Some(stated)) = (&construction.forces, scene.sheet.force_scale) {
            let acting = forces.bodies.iter().flat_map(|body| &body.acting);
            let acting = acting.chain(&forces.whole).chain(&forces.inertia).chain(&forces.frame);
            sizes.extend(acting.map(|acting| libm::hypot(acting.force[0], acting.force[1]) / stated));
        }
    }
    sizes.into_iter().fold(0.0, f64::max)
}

/// How many points have another nearer than `least` that is not the same point.
fn too_near(points: &[[f64; 2]], least: f64) -> usize {
    let same = least * 1e-3;
    // Of a crowd in one place one stands for all.
    let mut places: HashMap<[u64; 2], (usize, [f64; 2])> = HashMap::new();
    for at in points {
        places.entry(at.map(f64::to_bits)).or_insert((0, *at)).0 += 1;
    }
    let field = |at: [f64; 2]| at.map(|x| (x / least).floor() as i64);
    let mut fields: HashMap<[i64; 2], Vec<[f64; 2]>> = HashMap::new();
    for (_, at) in places.values() {
        fields.entry(field(*at)).or_default().push(*at);
    }
    let near = |at: [f64; 2]| {
        let [x, y] = field(at);
        let around = [-1, 0, 1].map(|i| [-1, 0, 1].map(|j| [x.saturating_add(i), y.saturating_add(j)]));
        let mut others = around.iter().flatten().filter_map(|field| fields.get(field)).flatten();
        others.any(|other| {
            let apart = libm::hypot(other[0] - at[0], other[1] - at[1]);
            apart > same && apart < least
        })
    };
    places.values().filter(|(_, at)| near(*at)).map(|(count, _)| count).sum()
}

/// The diagrams of a figure that find no room on their paper, and the next scale at which they do, SI per mm: what stands
/// on a skeleton besides its joints (a wheel, a guide, an arm of a force) is known when it is drawn. `pages` is how many
/// there may be: a smaller skeleton may save the others. None where the scene states the scale.
#[must_use]
pub fn outgrown(
    scene: &Scene,
    construction: &Construction,
    figure: &Figure,
    pages: Option<usize>,
) -> Option<(Dimension, f64)> {
    /// Nothing is made smaller than by so much: what lies further off does so at any scale.
    const MOST: f64 = 6.0;
    let (wide, high) = free_paper(scene);
    let room = (wide, high - HEADED);
    let next = |dimension: Dimension, [w, h]: [f64; 2]| {
        let per_mm = match dimension {
            Dimension::Length => construction.space.metres_per_mm,
            _ => construction.diagrams.iter().find(|own| own.kind.dimension() == dimension)?.si_per_mm,
        };
        let next = match dimension {
            Dimension::Length => choose_length(w * per_mm, h * per_mm, room),
            _ => choose_for(w * per_mm, h * per_mm, room, unit(scene, dimension)),
        };
        let next = next.filter(|next| *next > per_mm * (1.0 + 1e-9) && *next < MOST * per_mm)?;
        stated(scene, dimension).is_none().then_some((dimension, next))
    };
    let panels = figure.pages().into_iter().flat_map(|page| &page.children).filter_map(|node| match node {
        Node::Group(group) if group.class == "panel" => Some(group),
        _ => None,
    });
    let too_large = panels.filter_map(|panel| {
        let ink = panel.bounds()?;
        // Blank at the edge of letters is no ink.
        let over = ink.width() > wide + 0.5 || ink.height() > room.1 + 0.5;
        let Some(Node::Group(drawing)) = panel.children.first().filter(|_| over) else { return None };
        // Figures of centres, of velocities carried over and of constructions on the skeleton find room by themselves.
        let dimension = match drawing.class.split(' ').next()? {
            "velocity" => Dimension::Velocity,
            "acceleration" => Dimension::Acceleration,
            "skeleton" | "free-body" => Dimension::Length,
            _ => return None,
        };
        Some((dimension, [ink.width(), ink.height()]))
    });
    let first = too_large.filter_map(|(dimension, size)| next(dimension, size)).next();
    let too_many = pages.is_some_and(|most| figure.pages().len() > most);
    first.or_else(|| next(Dimension::Length, [wide * 1.01, 0.0]).filter(|_| too_many))
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

/// The next round scales of a skeleton below one, metres per mm, as far as a fifth of its size.
pub(super) fn smaller(metres_per_mm: f64) -> impl Iterator<Item = f64> {
    let steps = [1.25, 2.0, 2.5, 4.0, 5.0].into_iter();
    steps.map(move |by| metres_per_mm * by).filter(|own| is_round(own * 1000.0, true))
}

/// The next round scales of a diagram above one, SI units per mm, by which it becomes smaller.
pub(super) fn coarser(si_per_mm: f64, unit_si: f64) -> impl Iterator<Item = f64> {
    /// What is a hundred times smaller is a point.
    const MOST: usize = 9;
    let per_mm = move |per_cm: f64| per_cm * unit_si / 10.0;
    let next = |per_cm: &f64| round_up(per_cm * (1.0 + 1e-6));
    std::iter::successors(Some(si_per_mm * 10.0 / unit_si), next).skip(1).take(MOST).map(per_mm)
}

/// Whether a number is round; of a ratio below 1, whether it is one to a round number.
fn is_round(number: f64, ratio: bool) -> bool {
    let own = if ratio && number < 1.0 - 1e-9 { 1.0 / number } else { number };
    round_up(own).is_some_and(|up| (up / own - 1.0).abs() < 1e-9)
}

/// The next round number, or ratio, below a round one.
fn round_below(number: f64, ratio: bool) -> Option<f64> {
    [1.25, 2.0].map(|by| number / by).into_iter().find(|own| is_round(*own, ratio))
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
    fn the_series_of_scales_downward() {
        let all = |from: f64, ratio| {
            std::iter::successors(Some(from), move |own| round_below(*own, ratio))
                .take(6)
                .collect::<Vec<f64>>()
        };
        let near = |found: Vec<f64>, wanted: [f64; 6]| {
            assert!(found.iter().zip(wanted).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{found:?}");
        };
        near(all(10.0, false), [10.0, 5.0, 2.5, 2.0, 1.0, 0.5]);
        // 5 : 1 enlarges, 1 : 5 reduces.
        near(all(5.0, true), [5.0, 2.5, 2.0, 1.0, 1.0 / 2.0, 1.0 / 2.5]);
        assert!(
            !is_round(4.0, true) && !is_round(1.25, true) && is_round(0.4, true) && !is_round(0.4, false)
        );
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
