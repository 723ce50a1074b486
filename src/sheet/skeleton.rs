//! The kinematic skeleton as ink.

use std::collections::BTreeMap;

use kurbo::{Point, Rect, Vec2};

use super::figure::{Group, Mark, Moment, Pen, Shape, Tone, on_circle};
use super::growth::Births;
use super::ink::{
    FINE, HEAD, LABEL, MOST_HATCHES, SMALL, THICK, THIN, arc_arrow, dot, hatch_below, hatch_inside, head,
    hull, page,
};
use super::labels::{Obstacles, Request, Site, place};
use super::notation::Notation;
use super::overlap::{overlaps_in, part_inside};
use super::polygon::short_arc;
use super::pose::{GuideLine, Pose};
use super::positions;
use super::rich::Rich;
use super::slots::{Opening, Slot};
use crate::graphical::construction::{Act, Calculation, Claim, Construction, ConstructionLine, Reference};
use crate::mechanism::quantity::{Answer, Order, Quantity};
use crate::mechanism::{Form, Guide, Input, LinkId, Mechanism, PointId, Rider, Roll, Slide};

/// An arc that costs more has no room, and is left out.
const NO_ROOM: f64 = 400.0;

/// Radius of a pin's circle.
pub(super) const PIN: f64 = 1.1;
/// Half length and half width of a slider.
pub(super) const BLOCK: (f64, f64) = (4.4, 2.5);
/// Half length and half width of a block in a slot.
pub(super) const SLOT_BLOCK: (f64, f64) = (3.2, 1.6);
/// Where more labels than this touch something, giving way one by one takes too long.
const HOPELESS: usize = 40;
/// Half width of a slot in which a pin runs without a block.
pub(super) const BARE: f64 = PIN + 0.35;
/// Room for lines about a small skeleton, mm.
const LEAST_AROUND: f64 = 60.0;
/// How far a guide reaches beyond its rider.
pub(super) const GUIDE: f64 = 13.0;

/// Which links show their rotation by a curved arrow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrows {
    /// Every link whose ω or angular acceleration is known.
    All,
    /// The driven links only: for figures that have lines enough.
    Inputs,
}

/// The link that an input turns.
fn driven(input: &Input) -> Option<LinkId> {
    match input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => Some(*link),
        Input::Slide { .. } => None,
    }
}

/// Ink and labels that are laid over a drawing.
#[derive(Debug, Default)]
pub struct Overlay {
    /// The ink.
    pub ink: Group,
    /// Its labels, placed together with those of the drawing.
    pub labels: Vec<Request>,
    /// The paper that there is for them all.
    pub within: Option<Rect>,
}

/// The skeleton of a question with the first fixed point at the origin of the group: what the scene states,
/// dimensioned, and nothing that the solution finds but the position in which it is drawn. And the points whose places
/// its dimensions give. `from`: the axes by which places are handed in.
#[must_use]
pub fn question(
    construction: &Construction,
    notation: &Notation<'_>,
    from: Option<&Origin>,
) -> (Group, Vec<PointId>) {
    let mut group = Group::new("skeleton");
    group.title = Some(notation.words.skeleton.to_owned());
    let mut artist = Artist::new(construction, notation);
    artist.links_and_joints(&mut group, false);
    if let Some(at) = from.and_then(|from| artist.pose.place(from.point)) {
        let axes = artist.axes(at);
        group.group(axes);
    }
    let known = artist.stated_rotations();
    artist.rotations(&mut group, known, false);
    let (arrows, names) = artist.driven_velocities();
    if !arrows.children.is_empty() {
        group.group(arrows);
    }
    artist.labels.extend(names);
    if let Some((on, along)) = artist.pose.axis_of_rotation() {
        group.group(super::governor::axis(on, along, construction));
    }
    let (loads, names) = super::forces::stated(notation, |point| artist.pose.place(point));
    if !loads.children.is_empty() {
        group.group(loads);
    }
    artist.labels.extend(names);
    artist.number_links();
    // Where something is asked of a point by the number of a link, the figure says which points lie there.
    let asked = |point: PointId| {
        notation.mechanism().asked.iter().any(|asked| asked.quantity.about().0.contains(&Some(point)))
    };
    for (index, point, all) in std::mem::take(&mut artist.fuller) {
        if asked(point) {
            artist.labels[index].text = all;
        }
    }
    let mut dimensions = artist.dimensions(&group);
    loop {
        let mut whole = group.clone();
        let mut requests = artist.labels.clone();
        let mut lines = Group::new("dimensions");
        for dimension in &dimensions {
            lines.group(dimension.ink.clone());
            requests.extend(dimension.text.clone());
        }
        whole.group(lines);
        let texts = place(&whole, &requests, None);
        whole.group(texts);
        let touching = overlaps_in(&whole, None).len();
        if dimensions.is_empty() || touching == 0 {
            return (whole, artist.dimensioned(&dimensions));
        }
        // In a crowd the dimensions that disturb most are left to the given data, and so on.
        let left_out = if touching > HOPELESS { dimensions.len() } else { dimensions.len().div_ceil(8) };
        dimensions.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        dimensions.truncate(dimensions.len() - left_out);
    }
}

/// The fixed point by which coordinates are counted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Origin {
    /// The point.
    pub point: PointId,
    /// Its own coordinates, metres.
    pub at: [f64; 2],
}

impl Origin {
    /// The fixed point at the origin of the world; where there is none, the first.
    #[must_use]
    pub fn of(mechanism: &Mechanism) -> Option<Self> {
        let fixed = mechanism.points.iter().enumerate().filter_map(|(index, point)| {
            let place = point.place.exact().filter(|_| mechanism.is_fixed(PointId(index)))?;
            Some(Self { point: PointId(index), at: [place[0].value, place[1].value] })
        });
        let all: Vec<Self> = fixed.collect();
        all.iter().find(|origin| origin.at == [0.0; 2]).or(all.first()).copied()
    }
}

/// How long the axes of coordinates are drawn, mm.
const AXIS: f64 = 22.0;

/// The skeleton with the first fixed point at the origin of the group.
#[must_use]
pub fn draw(construction: &Construction, notation: &Notation<'_>) -> Group {
    draw_under(construction, notation, Arrows::All, None, |_, _| Overlay::default())
}

/// The ink of the skeleton without its names, with the lives of the ink, and the names that are to be placed. `turning`: the links
/// that have a curved arrow even where they do not turn (it is drawn counterclockwise then), and whether that is of their second
/// order.
#[must_use]
pub fn apart(
    construction: &Construction,
    notation: &Notation<'_>,
    births: &Births<'_>,
    turning: &[(LinkId, bool)],
) -> (Group, Vec<Request>, Vec<Opening>) {
    let mut group = Group::new("skeleton");
    // What moves keeps every point, wherever it lies.
    let mut artist = Artist { births: Some(births), far: Vec::new(), ..Artist::new(construction, notation) };
    artist.links_and_joints(&mut group, true);
    let mut known = artist.known_rotations();
    turning.iter().for_each(|own| {
        known.entry(*own).or_insert(0.0);
    });
    artist.rotations(&mut group, known, true);
    artist.number_links();
    let openings = artist.openings();
    (group, artist.labels, openings)
}

/// The same with the lives of its ink.
#[must_use]
pub fn growing(construction: &Construction, notation: &Notation<'_>, births: &Births<'_>) -> Group {
    draw_under(construction, notation, Arrows::All, Some(births), |_, _| Overlay::default())
}

/// The links whose ω is known and not zero and, where the second is set, those of which this is so of the angular acceleration.
#[must_use]
pub fn turning(construction: &Construction, notation: &Notation<'_>) -> Vec<(LinkId, bool)> {
    Artist::new(construction, notation).known_rotations().into_keys().collect()
}

/// What a skeleton covers of the page before anything on it is named.
#[must_use]
pub fn covers(construction: &Construction, notation: &Notation<'_>, arrows: Arrows) -> Rect {
    let (mut artist, mut group, known) = bare(construction, notation, arrows, None);
    artist.rotations(&mut group, known, true);
    group.bounds().unwrap_or(Rect::ZERO)
}

/// The skeleton's links and joints, who draws on, and the rotations that are shown.
fn bare<'a>(
    construction: &'a Construction,
    notation: &Notation<'a>,
    arrows: Arrows,
    births: Option<&'a Births<'a>>,
) -> (Artist<'a>, Group, BTreeMap<(LinkId, bool), f64>) {
    let space = &construction.space;
    let unit = &notation.scene.units.length;
    let mut group = Group::new("skeleton")
        .data("scale", format!("{}", space.metres_per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol))
        .data("si-per-mm", format!("{}", space.metres_per_mm));
    group.title = Some(notation.words.skeleton.to_owned());
    let mut artist = Artist { births, ..Artist::new(construction, notation) };
    if !construction.others.is_empty() {
        let (ink, names) = positions::draw(construction, notation);
        group.group(ink);
        artist.labels.extend(names);
    }
    artist.links_and_joints(&mut group, true);
    let (coils, names) = super::forces::springs(notation, |point| artist.pose.place(point));
    coils.into_iter().for_each(|coil| group.group(coil));
    artist.labels.extend(names);
    let mut known = artist.known_rotations();
    if arrows == Arrows::Inputs {
        let inputs: Vec<LinkId> = notation.mechanism().inputs.iter().filter_map(driven).collect();
        known.retain(|(link, second), _| !second && inputs.contains(link));
    }
    (artist, group, known)
}

/// The skeleton with what is laid over it: asked for when the skeleton's own ink stands, with the places of the
/// points on the page.
#[must_use]
pub fn draw_under(
    construction: &Construction,
    notation: &Notation<'_>,
    arrows: Arrows,
    births: Option<&Births<'_>>,
    overlay: impl FnOnce(Rect, &[Option<Point>]) -> Overlay,
) -> Group {
    let (mut artist, group, known) = bare(construction, notation, arrows, births);
    let names = artist.labels.clone();
    let places: Vec<Option<Point>> =
        (0..notation.mechanism().points.len()).map(|i| artist.pose.place(PointId(i))).collect();
    let mut overlay = Some(overlay);
    let mut over = Overlay::default();
    // In a crowd the curved arrows give way to the names: those of α first, then those of ω.
    let keep: [fn(bool) -> bool; 3] = [|_| true, |second| !second, |_| false];
    let mut tries = keep.into_iter().peekable();
    while let Some(keep) = tries.next() {
        artist.labels = names.clone();
        let mut whole = group.clone();
        let kept = known.clone().into_iter().filter(|((_, second), _)| keep(*second)).collect();
        artist.rotations(&mut whole, kept, true);
        artist.number_links();
        if let Some(overlay) = overlay.take() {
            over = overlay(whole.bounds().unwrap_or(Rect::ZERO), &places);
        }
        if !over.ink.children.is_empty() {
            whole.group(over.ink.clone());
        }
        artist.labels.extend(over.labels.iter().cloned());
        artist.within = over.within;
        let labels = artist.placed_labels(&whole);
        whole.group(labels);
        let touching = overlaps_in(&whole, None).len();
        if tries.peek().is_none() || touching == 0 {
            return whole;
        }
        if touching > HOPELESS {
            tries.next_if(|_| true);
        }
    }
    group
}

pub(super) struct Artist<'a> {
    pub(super) construction: &'a Construction,
    pub(super) notation: Notation<'a>,
    pub(super) pose: Pose<'a>,
    /// The straight strokes of all links, for keeping symbols away from them.
    pub(super) bars: Vec<(LinkId, Point, Point)>,
    pub(super) slots: Vec<Slot>,
    pub(super) labels: Vec<Request>,
    /// Fuller texts for some of the labels, by index: taken where all of them find room.
    fuller: Vec<(usize, PointId, Rich)>,
    /// Centres of arcs that are not on the paper: an arrow leads there.
    pub(super) far: Vec<PointId>,
    /// When its ink came onto the paper, where that is asked for.
    births: Option<&'a Births<'a>>,
    /// The paper that there is for its names, where they might leave it.
    within: Option<Rect>,
}

/// How the points of a link lie.
pub(super) enum Body {
    /// Nothing, or one point.
    Point,
    /// All on one line: its two extreme points, and those between.
    Straight(Point, Point, Vec<Point>),
    /// A polygon.
    Polygon(Vec<Point>),
}

impl<'a> Artist<'a> {
    pub(super) fn new(construction: &'a Construction, notation: &Notation<'a>) -> Self {
        let mut artist = Self {
            construction,
            notation: *notation,
            pose: Pose::new(notation.mechanism(), &construction.space),
            bars: Vec::new(),
            slots: Vec::new(),
            labels: Vec::new(),
            fuller: Vec::new(),
            far: construction.far_centres(notation.mechanism()),
            births: None,
            within: None,
        };
        artist.bars = artist.all_bars();
        artist.add_slots();
        let more = [artist.rack_arms(), artist.tubes()].concat();
        artist.bars.extend(more);
        artist
    }
}

impl Artist<'_> {
    pub(super) fn born_point(&self, point: PointId) -> Option<Moment> {
        self.births.map(|births| births.point(point))
    }

    pub(super) fn born_link(&self, link: LinkId) -> Option<Moment> {
        self.births.map(|births| births.link(link))
    }

    pub(super) fn born_guide(&self, slide: usize) -> Option<Moment> {
        self.births.map(|births| births.guide(slide))
    }

    pub(super) fn born_rider(&self, slide: &Slide) -> Option<Moment> {
        self.births.map(|births| births.rider(slide))
    }

    /// Frame, guides, links, wheels, joints, crank angles; the lines by which places were found if wanted.
    fn links_and_joints(&mut self, group: &mut Group, construction_lines: bool) {
        group.group(self.ground());
        // A slotted link lies over the frame and its sliders, blocks cover their slots, and the bar of a
        // rod runs on to the pin inside its block.
        group.group(self.slides(true));
        group.group(self.slots());
        group.group(self.slides(false));
        group.group(self.links());
        group.group(self.rolls());
        group.group(self.square_guides());
        if construction_lines {
            group.group(self.construction_lines());
        }
        group.group(self.joints());
        group.group(self.crank_angles());
    }

    /// The labels with the fuller texts where they exceed everything, else with the shorter ones.
    fn placed_labels(&self, group: &Group) -> Group {
        // Beside their points where there is room, else on leaders.
        for leader in [false, true].into_iter().filter(|_| !self.fuller.is_empty()) {
            let mut requests = self.labels.clone();
            for (i, _, text) in &self.fuller {
                requests[*i].text = text.clone();
                requests[*i].leader = leader;
            }
            let labels = place(group, &requests, self.within);
            let mut both = group.clone();
            both.group(labels.clone());
            if overlaps_in(&both, None).is_empty() {
                return labels;
            }
        }
        place(group, &self.labels, self.within)
    }

    pub(super) fn body(&self, link: LinkId) -> Body {
        // The centre of a curved slot is a mark on the paper, not a joint of the link.
        let of_slot = self.slot_centres(link);
        let places = self.pose.places(link).into_iter().filter(|(p, _)| !of_slot.contains(p));
        let places: Vec<Point> = places.map(|(_, p)| p).collect();
        let mut widest: Option<(Point, Point)> = None;
        for (i, a) in places.iter().enumerate() {
            for b in &places[i + 1..] {
                if widest.is_none_or(|(p, q)| a.distance(*b) > p.distance(q)) {
                    widest = Some((*a, *b));
                }
            }
        }
        let Some((a, b)) = widest.filter(|(a, b)| a.distance(*b) > 1e-6) else { return Body::Point };
        let d = (b - a).normalize();
        let off = |p: &Point| (*p - a).cross(d).abs();
        // Closer to the line than half its width: drawn as on it.
        if places.iter().all(|p| off(p) < THIN) {
            let between = places.iter().copied().filter(|p| p.distance(a) > 0.3 && p.distance(b) > 0.3);
            Body::Straight(a, b, between.collect())
        } else {
            Body::Polygon(hull(&places))
        }
    }

    fn all_bars(&self) -> Vec<(LinkId, Point, Point)> {
        let mut bars = Vec::new();
        for link in self.notation.mechanism().moving() {
            if let Some([vertex, one, other]) = self.two_arms(link) {
                bars.extend([(link, vertex, one), (link, vertex, other)]);
                continue;
            }
            match self.body(link) {
                Body::Point => {}
                Body::Straight(a, b, _) => bars.push((link, a, b)),
                Body::Polygon(corners) => {
                    let next = corners.iter().cycle().skip(1);
                    bars.extend(corners.iter().zip(next).map(|(a, b)| (link, *a, *b)));
                }
            }
        }
        bars
    }

    /// The slots, and with the links' own strokes those by which slots depend on them.
    fn add_slots(&mut self) {
        self.slots = self.all_slots(&self.bars);
        let mut more = Vec::new();
        for slot in &self.slots {
            more.extend(slot.arm.map(|(a, b)| (slot.link, a, b)));
            if let (Body::Point, Some((_, joint))) =
                (self.body(slot.link), self.pose.places(slot.link).first())
            {
                let (a, b) = slot.ends;
                let far = if a.distance(*joint) > b.distance(*joint) { a } else { b };
                // From its joint, or from end to end where it depends on an arm.
                let near = if slot.arm.is_some() { if far == a { b } else { a } } else { *joint };
                more.push((slot.link, near, far));
            }
        }
        self.bars.append(&mut more);
    }

    /// Where lines may run on the paper: as far around what stands there as that is large. A guide may be stated by a point
    /// any distance away.
    pub(super) fn window(&self) -> Rect {
        let places = self.construction.space.places.iter().flatten().map(|at| page(*at));
        let own = places.fold(None, |all: Option<Rect>, at| {
            Some(all.map_or(Rect::from_points(at, at), |all| all.union_pt(at)))
        });
        let own = own.unwrap_or(Rect::ZERO);
        let around = own.width().max(own.height()).max(LEAST_AROUND);
        own.inflate(around, around)
    }

    fn construction_lines(&self) -> Group {
        let mut all = Group::new("construction");
        let window = self.window();
        for (index, line) in self.construction.space.lines.iter().enumerate() {
            let born = self.births.map(|births| births.line(index));
            if let Some(arc) = short_arc(line) {
                all.mark_lived(arc, born);
            } else if let ConstructionLine::Ray { from, to, claim, .. } = line {
                let (from, to) = (page(*from), page(*to));
                let d = to - from;
                if d.hypot() > 1e-9 {
                    // The line of a guide is an axis.
                    let axis = matches!(claim, Some(Claim::Parallel(Reference::Guide(_))));
                    let pen = if axis { Pen::chain(FINE) } else { Pen::solid(FINE) };
                    let Some((from, to)) = part_inside(from, to + d.normalize() * 4.0, window) else {
                        continue;
                    };
                    let shape = Shape::Line(from, to);
                    let class = if axis { "axis" } else { "ray" };
                    all.mark_lived(Mark::stroke(shape, pen).class(class).precise(), born);
                }
            }
        }
        all
    }

    /// The fixed points that carry a moving link.
    fn pivots(&self) -> Vec<(PointId, Point)> {
        let mechanism = self.notation.mechanism();
        (0..mechanism.points.len())
            .map(PointId)
            .filter(|p| mechanism.is_fixed(*p))
            .filter(|p| mechanism.points[p.0].links.iter().any(|l| *l != LinkId::FRAME))
            .filter_map(|p| Some((p, self.pose.place(p)?)))
            .collect()
    }

    /// Which way a support hangs from its pivot: down where links leave room, else to a side.
    fn support_direction(&self, at: Point) -> Vec2 {
        let ways = [(0.0, 1.0), (1.0, 0.0), (-1.0, 0.0), (0.0, -1.0)];
        let mut best = (f64::INFINITY, Vec2::new(0.0, 1.0));
        for (rank, (x, y)) in ways.into_iter().enumerate() {
            let way = Vec2::new(x, y);
            let ground = at + way * 6.5;
            let seat = Rect::from_center_size(at + way * 4.2, (9.0, 9.0));
            let mut cost = [0.0, 3.0, 3.0, 5.0][rank];
            for (_, a, b) in &self.bars {
                if super::overlap::clip(*a, *b, seat).is_some() {
                    let d = nearest(*a, *b, ground).distance(ground);
                    cost += 10.0 + (6.0 - d).max(0.0) * 4.0;
                }
            }
            if cost < best.0 {
                best = (cost, way);
            }
        }
        best.1
    }

    fn ground(&mut self) -> Group {
        let mut all = Group::new("frame");
        for (point, at) in self.pivots() {
            let way = self.support_direction(at);
            let side = Vec2::new(-way.y, way.x);
            let mut own = Group::new("support").data("point", self.notation.point_name(point));
            let (left, right) = (at + way * 4.6 - side * 2.6, at + way * 4.6 + side * 2.6);
            own.mark(Mark::stroke(Shape::Polyline(vec![left, at, right]), Pen::solid(THIN)));
            let (a, b) = (at + way * 4.6 + side * 4.2, at + way * 4.6 - side * 4.2);
            own.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(THICK)));
            // Hatching lies on the far side of the base line, whichever way that is.
            hatch_below(&mut own, a, b);
            let born = self.born_point(point);
            all.group(own.lived(born));
            self.frame_number(at + way * 5.4, 2.2, way, born);
        }
        let slides = self.notation.mechanism().slides.iter().enumerate();
        for (index, slide) in slides.filter(|(_, s)| s.guide.link == LinkId::FRAME) {
            let born = self.born_guide(index);
            // A pin without a block runs in a slot of its own width.
            let bare = matches!(slide.rider, Rider::Pin { block: None, .. });
            if let Some(GuideLine::Straight { at, along }) = self.pose.guide(slide) {
                let own = self.fixed_guide(at, along, bare, born);
                all.group(own.data("guide", self.notation.guide_data(index)).lived(born));
            } else if let Some(GuideLine::Arc { at, centre }) = self.pose.guide(slide)
                && at.distance(centre) > BLOCK.1
            {
                let own = fixed_arc(at, centre, bare);
                all.group(own.data("guide", self.notation.guide_data(index)).lived(born));
                let out = (at - centre).normalize();
                self.frame_number(at + out * 3.5 + Vec2::new(-out.y, out.x) * GUIDE, 0.5, out, born);
            }
        }
        all
    }

    fn frame_number(&mut self, at: Point, radius: f64, way: Vec2, born: Option<Moment>) {
        let toward = Some(libm::atan2(-way.x, -way.y));
        let site = Site::Around { at, radius, toward };
        self.labels.push(Request::new(Rich::upright("1"), SMALL, site, "label link-number").lived(born));
    }

    /// Across a straight guide of the frame to the side where fewer links are: there is the frame.
    pub(super) fn frame_side(&self, at: Point, along: Vec2) -> Vec2 {
        let across = Vec2::new(-along.y, along.x);
        let inclination: f64 = self
            .bars
            .iter()
            .flat_map(|(_, a, b)| [(a, b), (b, a)])
            .filter(|(near, _)| near.distance(at) < 0.5)
            .map(|(_, far)| (*far - at).dot(across))
            .sum();
        if inclination > 0.0 || (inclination == 0.0 && across.y < 0.0) { -across } else { across }
    }

    /// A straight guide of the frame: its surface under the slider, hatched away from the links; for a bare pin a slot,
    /// hatched on both sides.
    fn fixed_guide(&mut self, at: Point, along: Vec2, bare: bool, born: Option<Moment>) -> Group {
        let mut own = Group::new("guide");
        let across = self.frame_side(at, along);
        let half = if bare { BARE } else { BLOCK.1 } + THICK / 2.0;
        let sides: &[Vec2] = if bare { &[across, -across] } else { &[across] };
        for (i, side) in sides.iter().enumerate() {
            let foot = at + *side * half;
            let (a, b) = (foot - along * GUIDE, foot + along * GUIDE);
            own.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(THICK)).precise());
            let (a, b) = if Vec2::new(-along.y, along.x).dot(*side) > 0.0 { (a, b) } else { (b, a) };
            hatch_below(&mut own, a, b);
            if i == 0 {
                self.frame_number(b, 0.6, -(b - a).normalize(), born);
            }
        }
        own
    }

    fn links(&mut self) -> Group {
        let mut all = Group::new("links");
        for link in self.notation.mechanism().moving() {
            if self.notation.mechanism().links[link.0].block {
                continue;
            }
            let mut own = Group::new("link").data("link", self.notation.number(link));
            let slotted = self.is_slotted(link);
            match self.body(link) {
                Body::Point => {}
                Body::Straight(a, b, between) => {
                    if !slotted {
                        own.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(THICK)).class("bar").precise());
                    }
                    for joint in between.into_iter().filter(|joint| self.is_pinned(*joint)) {
                        self.continuity(link, joint, (b - a).normalize(), &mut own);
                    }
                }
                Body::Polygon(corners) => self.plate(link, &corners, &mut own),
            }
            if !own.children.is_empty() {
                all.group(own.lived(self.born_link(link)));
            }
        }
        all
    }

    /// Whether a turning pair is at this place.
    fn is_pinned(&self, at: Point) -> bool {
        let pins = &self.notation.mechanism().pins;
        pins.iter().filter_map(|pin| self.pose.place(pin.point)).any(|p| p.distance(at) < 0.3)
    }

    /// A bell crank's joint between its arms and the ends of these, where it is drawn as two arms.
    fn two_arms(&self, link: LinkId) -> Option<[Point; 3]> {
        let Form::Arms { .. } = self.notation.mechanism().links[link.0].form else { return None };
        let [(_, vertex), (_, one), (_, other)] = self.pose.places(link)[..] else { return None };
        let bent = matches!(self.body(link), Body::Polygon(_));
        let seen = one.distance(vertex) > PIN && other.distance(vertex) > PIN;
        (bent && seen).then_some([vertex, one, other])
    }

    /// A link of three or more points: outlined and lightly hatched; a bell crank as two arms with a web.
    fn plate(&self, link: LinkId, corners: &[Point], own: &mut Group) {
        let places = self.pose.places(link);
        if let Some([vertex, one, other]) = self.two_arms(link) {
            let arms = Shape::Polyline(vec![one, vertex, other]);
            own.mark(Mark::stroke(arms, Pen::solid(THICK)).class("bar").precise());
            let (u, v) = ((one - vertex).normalize(), (other - vertex).normalize());
            let reach = 4.5_f64.min(one.distance(vertex) / 2.0).min(other.distance(vertex) / 2.0);
            let web = Shape::Polygon(vec![vertex, vertex + u * reach, vertex + v * reach]);
            own.mark(Mark::area(web, Tone::Ink).class("web"));
            return;
        }
        hatch_inside(own, corners, 2.6);
        let outline = Shape::Polygon(corners.to_vec());
        own.mark(Mark::stroke(outline, Pen::solid(THICK)).class("bar").precise());
        // Points inside the outline depend on it by an arm.
        for (_, p) in places {
            let on_corner = corners.iter().any(|c| c.distance(p) < 0.3);
            if !on_corner
                && let Some(near) = corners.iter().min_by(|a, b| a.distance(p).total_cmp(&b.distance(p)))
            {
                own.mark(Mark::stroke(Shape::Line(p, *near), Pen::solid(THIN)).class("arm"));
            }
        }
    }

    /// A small bridge over a middle joint: the link runs on there.
    fn continuity(&self, link: LinkId, joint: Point, along: Vec2, own: &mut Group) {
        let mut side = Vec2::new(along.y, -along.x);
        let others: f64 = self
            .bars
            .iter()
            .filter(|(l, ..)| *l != link)
            .flat_map(|(_, a, b)| [(a, b), (b, a)])
            .filter(|(near, _)| near.distance(joint) < 0.5)
            .map(|(_, far)| (*far - joint).normalize().dot(side))
            .sum();
        let support = if self.pivots().iter().any(|(_, p)| p.distance(joint) < 0.5) {
            self.support_direction(joint).dot(side)
        } else {
            0.0
        };
        if others + support > 0.0 {
            side = -side;
        }
        let start = libm::atan2(-along.y, along.x);
        let ccw = along.cross(side) < 0.0;
        let sweep = if ccw { std::f64::consts::PI } else { -std::f64::consts::PI };
        let arc = Shape::Arc { centre: joint, radius: 2.3, start, sweep };
        own.mark(Mark::stroke(arc, Pen::solid(THICK)).class("continuity"));
    }

    fn rolls(&mut self) -> Group {
        let mut all = Group::new("pitch-circles");
        for roll in &self.notation.mechanism().rolls {
            match roll {
                Roll::Circles { links, centres, radii, internal } => {
                    let places = centres.map(|c| self.pose.place(c));
                    let sizes = radii.map(|r| self.pose.paper(r.value));
                    let ring = *internal && radii[0].value > radii[1].value;
                    let rings = [ring, *internal && !ring];
                    for i in 0..2 {
                        let Some(centre) = places[i] else { continue };
                        let born = self.born_point(centres[i]);
                        all.mark_lived(pitch_circle(centre, sizes[i]), born);
                        if links[i] == LinkId::FRAME {
                            let rim = self.fixed_rim(centre, sizes[i], rings[i], born);
                            all.group(rim.lived(born));
                        }
                    }
                    if let [Some(a), Some(b)] = places
                        && a.distance(b) > 0.0
                    {
                        // Inside a ring the contact is beyond the smaller wheel's centre.
                        let outward = if rings[1] { -1.0 } else { 1.0 };
                        let born = self.born_point(centres[0]).max(self.born_point(centres[1]));
                        let along = (b - a).normalize();
                        let mut own = Group::default().lived(born);
                        tangency(&mut own, a + along * (sizes[0] * outward), along);
                        all.adopt(own);
                    }
                }
                Roll::Line { guide, centre, radius, .. } => {
                    let born = self.born_point(*centre);
                    let Some(centre) = self.pose.place(*centre) else { continue };
                    let r = self.pose.paper(radius.value);
                    let mut own = Group::default().lived(born);
                    own.mark(pitch_circle(centre, r));
                    if let Some((on, along)) = self.pose.track(*guide) {
                        let foot = on + along * (centre - on).dot(along);
                        let mut ends = [-(r + 5.0), r + 5.0];
                        if let Some((_, joint, end)) = self.rack_arm(*guide) {
                            let reach = (end - foot).dot(along);
                            ends = [ends[0].min(reach), ends[1].max(reach)];
                            if joint.distance(end) > THIN {
                                let arm =
                                    Mark::stroke(Shape::Line(joint, end), Pen::solid(THICK)).class("bar");
                                own.mark(arm);
                            }
                        }
                        let [a, b] = ends.map(|end| foot + along * end);
                        own.mark(Mark::stroke(Shape::Line(a, b), Pen::solid(THICK)).class("rack"));
                        own.mark(dot(foot, 0.6).class("tangency"));
                        if guide.link == LinkId::FRAME {
                            let below = Vec2::new(-along.y, along.x).dot(foot - centre) > 0.0;
                            let (a, b) = if below { (a, b) } else { (b, a) };
                            hatch_below(&mut own, a, b);
                            self.frame_number(b, 0.6, -(b - a).normalize(), born);
                        }
                    }
                    all.adopt(own);
                }
            }
        }
        all
    }

    /// How a moving rack hangs on its link: from the joint nearest to its line to the foot there; of a joint on the line both
    /// are that joint.
    fn rack_arm(&self, guide: Guide) -> Option<(LinkId, Point, Point)> {
        if guide.link == LinkId::FRAME {
            return None;
        }
        let (on, along) = self.pose.track(guide)?;
        let foot = |joint: Point| on + along * (joint - on).dot(along);
        let joints = self.pose.places(guide.link).into_iter().map(|(_, joint)| (joint, foot(joint)));
        let nearer = |a: (Point, Point), b: (Point, Point)| {
            if b.0.distance(b.1) < a.0.distance(a.1) - THIN { b } else { a }
        };
        joints.reduce(nearer).map(|(joint, end)| (guide.link, joint, end))
    }

    /// The same as strokes that symbols keep away from.
    fn rack_arms(&self) -> Vec<(LinkId, Point, Point)> {
        let arms = self.notation.mechanism().rolls.iter().filter_map(|roll| match roll {
            Roll::Line { guide, .. } => self.rack_arm(*guide),
            Roll::Circles { .. } => None,
        });
        arms.filter(|(_, joint, end)| joint.distance(*end) > THIN).collect()
    }

    /// A piece of a fixed wheel's rim, hatched on the wheel's side, where least stands in the way.
    fn fixed_rim(&mut self, centre: Point, radius: f64, ring: bool, born: Option<Moment>) -> Group {
        let mut own = Group::new("rim");
        let half = (0.8 * GUIDE / radius.max(1.0)).min(0.8);
        let free = |middle: &f64| {
            let at = on_circle(centre, radius, *middle);
            let near = |(_, a, b): &(LinkId, Point, Point)| nearest(*a, *b, at).distance(at);
            self.bars.iter().map(near).fold(f64::INFINITY, f64::min).min(12.0)
        };
        // Below, else to the sides.
        let ways = [-0.5, 0.75, 0.25, -0.75, -0.25].map(|turn| turn * std::f64::consts::PI);
        let middle = ways.into_iter().reduce(|a, b| if free(&b) > free(&a) + 1e-6 { b } else { a });
        let middle = middle.unwrap_or_default();
        let rim = Shape::Arc { centre, radius, start: middle - half, sweep: 2.0 * half };
        own.mark(Mark::stroke(rim, Pen::solid(THICK)));
        let depth = if ring { 1.5 } else { -1.5 };
        let strokes = (2.0 * half * radius / 1.5).floor().clamp(2.0, MOST_HATCHES);
        for i in 0..strokes as usize {
            let angle = middle - half + (i as f64 + 0.5) * (2.0 * half / strokes);
            let from = on_circle(centre, radius, angle);
            let to = on_circle(centre, radius + depth, angle - 1.5 / radius.max(1.5));
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("hatch"));
        }
        let way = (on_circle(centre, 1.0, middle) - centre) * depth.signum();
        self.frame_number(on_circle(centre, radius + depth, middle), 0.4, way, born);
        own
    }

    fn joints(&mut self) -> Group {
        let mut all = Group::new("joints");
        let mechanism = self.notation.mechanism();
        for (i, point) in mechanism.points.iter().enumerate() {
            let id = PointId(i);
            let Some(at) = self.pose.place(id).filter(|_| !self.far.contains(&id)) else { continue };
            let pinned = mechanism.pins.iter().any(|p| p.point == id);
            let rides =
                mechanism.slides.iter().any(|s| matches!(s.rider, Rider::Pin { point, .. } if point == id));
            let in_use = point.links.iter().any(|l| *l != LinkId::FRAME);
            let mut own = Group::new("joint").data("point", point.name.clone());
            let radius = if pinned || rides {
                let circle = Shape::Circle { centre: at, radius: PIN };
                own.mark(Mark::outlined(circle, Pen::solid(THIN * 1.4), Tone::Paper).precise());
                PIN
            } else {
                own.mark(dot(at, 0.5).precise());
                0.5
            };
            if !in_use && !rides {
                own.class = "joint reference".to_owned();
            }
            let born = self.born_point(id);
            all.group(own.lived(born));
            let site = Site::Around { at, radius: radius + 0.2, toward: self.outward(at) };
            let mut request = Request::new(self.notation.point(id), LABEL, site, "label point-name")
                .naming([point.name.clone()])
                .lived(born);
            request.leader = true;
            if let Some(all) = self.notation.coincident_names(id) {
                self.fuller.push((self.labels.len(), id, all));
            }
            self.labels.push(request);
        }
        all
    }

    pub(super) fn outward(&self, at: Point) -> Option<f64> {
        let sum: Vec2 = self
            .bars
            .iter()
            .flat_map(|(_, a, b)| [(a, b), (b, a)])
            .filter(|(near, _)| near.distance(at) < 0.5)
            .map(|(_, far)| (*far - at).normalize())
            .fold(Vec2::ZERO, |s, d| s + d);
        (sum.hypot() > 0.3).then(|| libm::atan2(sum.y, -sum.x))
    }

    /// θ₂ from the horizontal, with its arc.
    fn crank_angles(&mut self) -> Group {
        let mut all = Group::new("angles");
        for (index, input) in self.notation.mechanism().inputs.iter().enumerate() {
            let (Input::Angle { link, angle: Some(angle), .. }
            | Input::Speed { link, angle: Some(angle), .. }) = input
            else {
                continue;
            };
            let stated = self.notation.scene.input_units.get(index).and_then(|input| input.angle);
            let angle = stated.unwrap_or(angle.value);
            let [(_, from), (_, to), ..] = self.pose.places(*link)[..] else { continue };
            let whole = angle.abs() > std::f64::consts::TAU;
            let turn = if whole { libm::remainder(angle, std::f64::consts::TAU) } else { angle };
            let radius = (from.distance(to) * 0.75).clamp(6.0, 11.0);
            let end = from + Vec2::new(radius + 3.0, 0.0);
            let born = self.born_link(*link);
            let mut own = Group::default().lived(born);
            own.mark(Mark::stroke(Shape::Line(from + Vec2::new(PIN, 0.0), end), Pen::solid(FINE)));
            if turn.abs() * radius > 1.5 {
                arc_arrow(&mut own, from, radius, 0.0, turn, FINE);
            }
            all.adopt(own);
            let middle = on_circle(from, radius, turn / 2.0);
            let site = Site::Around { at: middle, radius: 0.3, toward: Some(turn / 2.0) };
            let text = self.notation.symbol(Quantity::Angle(*link), false).up("\u{a0}=\u{a0}");
            let text = text.then(&super::given::degrees(angle, &self.notation));
            let beyond = Site::Around { at: end, radius: 0.3, toward: Some(0.0) };
            let quarter = on_circle(from, radius, turn / 4.0);
            let quarter = Site::Around { at: quarter, radius: 0.3, toward: Some(turn / 4.0) };
            let mut request =
                Request::new(text, SMALL, site, "label angle").or(quarter).or(beyond).lived(born);
            request.leader = true;
            self.labels.push(request);
        }
        all
    }

    /// The axes of coordinates, parallel to those of the world, from this place.
    fn axes(&mut self, at: Point) -> Group {
        let mut all = Group::new("axes");
        for (name, along) in [("x", Vec2::new(1.0, 0.0)), ("y", Vec2::new(0.0, -1.0))] {
            let end = at + AXIS * along;
            all.mark(Mark::stroke(Shape::Line(at, end - HEAD * along), Pen::solid(FINE)));
            all.mark(head(end, along, HEAD));
            let site = Site::Around { at: end, radius: 0.3, toward: Some(libm::atan2(-along.y, along.x)) };
            let mut request = Request::new(Rich::italic(name), SMALL, site, "label axis");
            request.leader = true;
            self.labels.push(request);
        }
        all
    }

    /// ω and α of the driven links.
    fn stated_rotations(&self) -> BTreeMap<(LinkId, bool), f64> {
        let mut known = BTreeMap::new();
        for input in &self.notation.mechanism().inputs {
            if let Input::Angle { link, omega, alpha, .. } = input {
                known.insert((*link, false), omega.value);
                known.insert((*link, true), alpha.value);
            }
        }
        known.retain(|_, value| *value != 0.0);
        known
    }

    /// ω and α of every link for which they are known.
    fn known_rotations(&self) -> BTreeMap<(LinkId, bool), f64> {
        let mut known = self.stated_rotations();
        for act in self.construction.steps.iter().flat_map(|s| &s.acts) {
            let Act::Calculate(calculation) = act else { continue };
            match *calculation {
                Calculation::Omega { link, value, .. } => {
                    known.insert((link, false), value);
                }
                Calculation::Alpha { link, value, .. } => {
                    known.insert((link, true), value);
                }
                Calculation::Speed { link, omega, .. } => {
                    known.insert((link, false), omega);
                }
                _ => {}
            }
        }
        let asked = &self.notation.mechanism().asked;
        for (asked, reading) in asked.iter().zip(&self.construction.answers) {
            if let Answer::Scalar { value, .. } = reading.answer {
                let value = if reading.zero { 0.0 } else { value };
                match asked.quantity {
                    Quantity::Omega(link) => known.insert((link, false), value),
                    Quantity::Alpha(link) => known.insert((link, true), value),
                    _ => None,
                };
            }
        }
        known.retain(|_, value| *value != 0.0);
        known
    }

    fn rotations(&mut self, group: &mut Group, known: BTreeMap<(LinkId, bool), f64>, values: bool) {
        let mut all = Group::new("rotations");
        let ink = Obstacles::of(group);
        let mut arcs = Obstacles::over(&ink);
        for ((link, second), value) in known {
            let Some((arc, cost)) = self.best_arc(&ink, &arcs, link, second) else { continue };
            if cost > NO_ROOM {
                continue;
            }
            let quantity = if second { Quantity::Alpha(link) } else { Quantity::Omega(link) };
            let unit = self.notation.angular_unit(if second { Order::Acceleration } else { Order::Velocity });
            let mut own = Group::new(if second { "rotation second" } else { "rotation" });
            if values {
                own = own
                    .data("quantity", self.notation.quantity_name(quantity))
                    .data("value", format!("{}", value / unit.si))
                    .data("unit", unit.symbol);
            }
            let Turn { centre, radius, middle, half } = arc;
            let sign = if value < 0.0 { -1.0 } else { 1.0 };
            let (start, sweep) = (middle - sign * half, 2.0 * sign * half);
            arc_arrow(&mut own, centre, radius, start, sweep, THIN);
            if second {
                // Two barbs tell the angular acceleration from the angular velocity.
                let back = (HEAD * 0.9) / radius;
                let angle = start + sweep - sign * back;
                let tip = on_circle(centre, radius, angle);
                let (sin, cos) = libm::sincos(angle - sign * back / 2.0);
                own.mark(head(tip, Vec2::new(-sin, -cos) * sign, HEAD * 0.9));
            }
            arcs.extend(&own);
            let born = self.births.map(|births| births.rotation(link, second));
            all.group(own.lived(born));
            let at = on_circle(centre, radius, middle);
            let site = Site::Around { at, radius: 0.2, toward: Some(middle) };
            let text = self.notation.symbol(quantity, false);
            self.labels.push(Request::new(text, SMALL, site, "label rotation-name").lived(born));
        }
        group.group(all);
    }

    /// Where a link's curved arrow disturbs least.
    fn best_arc(&self, ink: &Obstacles, arcs: &Obstacles, link: LinkId, second: bool) -> Option<(Turn, f64)> {
        let mut best: Option<(Turn, f64)> = None;
        for (turn, taste) in self.arcs(link, second) {
            let mut cost = taste;
            let pieces = 9;
            let least = best.as_ref().map_or(f64::INFINITY, |(_, least)| *least);
            for i in 0..=pieces {
                if cost >= least || cost > NO_ROOM {
                    break;
                }
                let angle = turn.middle + turn.half * (f64::from(i) / f64::from(pieces) * 2.0 - 1.0);
                let at = on_circle(turn.centre, turn.radius, angle);
                let own = Rect::from_center_size(at, (1.0, 1.0));
                cost += (ink.cost_up_to(own, 60.0) + arcs.cost_up_to(own, 60.0)).min(60.0);
            }
            // It only gets dearer: in a crowd most arcs are given up here.
            if cost >= least || cost > NO_ROOM {
                continue;
            }
            // Room for its name.
            let name = on_circle(turn.centre, turn.radius + 3.4, turn.middle);
            let own = Rect::from_center_size(name, (4.6, 3.0));
            cost += (ink.cost_up_to(own, 80.0) + arcs.cost_up_to(own, 80.0)).min(80.0);
            if best.as_ref().is_none_or(|(_, least)| cost < *least) {
                best = Some((turn, cost));
            }
        }
        best
    }

    fn arcs(&self, link: LinkId, second: bool) -> Vec<(Turn, f64)> {
        let mut all = Vec::new();
        let places = self.pose.places(link);
        let bar = self.bars.iter().find(|(l, ..)| *l == link).copied();
        // A wheel without arms turns about its only joint.
        let pivot = places.iter().find(|(p, _)| self.notation.mechanism().is_fixed(*p));
        let pivot = pivot.or(if bar.is_none() { places.first() } else { None });
        if let Some((_, centre)) = pivot {
            for (i, radius) in [6.5, 8.0, 9.5, 11.5, 14.0].into_iter().enumerate() {
                for k in 0..36 {
                    let middle = f64::from(k) * (std::f64::consts::TAU / 36.0);
                    let near = places
                        .iter()
                        .filter(|(_, p)| p.distance(*centre) > 0.5)
                        .map(|(_, p)| {
                            let d = *p - *centre;
                            let own = libm::atan2(-d.y, d.x);
                            libm::remainder(middle - own, std::f64::consts::TAU).abs()
                        })
                        .fold(std::f64::consts::PI, f64::min);
                    let turn = Turn { centre: *centre, radius, middle, half: 5.0 / radius };
                    all.push((turn, 1.5 * i as f64 + 3.0 * near));
                }
            }
            return all;
        }
        // About a wheel that is too small for them inside.
        for (centre, size) in self.wheels(link) {
            for (i, beyond) in [2.0, 3.5].into_iter().enumerate() {
                let radius = size + beyond;
                for k in 0..36 {
                    let middle = f64::from(k) * (std::f64::consts::TAU / 36.0);
                    let turn = Turn { centre, radius, middle, half: 5.0 / radius };
                    all.push((turn, 4.0 + 1.5 * i as f64 + 0.5 * size));
                }
            }
        }
        let Some((_, a, b)) = bar else { return all };
        let along = (b - a).normalize();
        let normal = libm::atan2(-along.x, -along.y);
        for (i, t) in [0.35, 0.65, 0.25, 0.75, 0.5].into_iter().enumerate() {
            for side in [0.0, std::f64::consts::PI] {
                for (j, radius) in [4.0, 5.0, 6.5].into_iter().enumerate() {
                    let middle = normal + side;
                    let turn = Turn { centre: a.lerp(b, t), radius, middle, half: 4.4 / radius };
                    all.push((turn, 0.5 * i as f64 + 1.0 * j as f64 + if second { 0.2 } else { 0.0 }));
                }
            }
        }
        all
    }

    /// Centres and radii of a link's pitch circles.
    fn wheels(&self, link: LinkId) -> Vec<(Point, f64)> {
        let circles = |roll: &Roll| match roll {
            Roll::Circles { links, centres, radii, .. } => {
                [0, 1].map(|i| (links[i], centres[i], radii[i].value)).to_vec()
            }
            Roll::Line { wheel, centre, radius, .. } => vec![(*wheel, *centre, radius.value)],
        };
        let all = self.notation.mechanism().rolls.iter().flat_map(circles);
        let own = all.filter(|(body, ..)| *body == link);
        own.filter_map(|(_, centre, radius)| Some((self.pose.place(centre)?, self.pose.paper(radius))))
            .collect()
    }

    fn number_links(&mut self) {
        let mut requests = Vec::new();
        let sleeves: Vec<LinkId> = self.tubes().into_iter().map(|(link, ..)| link).collect();
        for link in self.notation.mechanism().moving() {
            let number = self.notation.number(link);
            let blocked = self.notation.mechanism().links[link.0].block;
            let longest = self
                .bars
                .iter()
                .filter(|(l, ..)| *l == link)
                .max_by(|x, y| x.1.distance(x.2).total_cmp(&y.1.distance(y.2)));
            match longest {
                // A block and a sleeve have their numbers already.
                Some(_) if blocked || sleeves.contains(&link) => {}
                Some((_, a, b)) => {
                    // A straight link with a middle joint is numbered on its longer piece.
                    let (from, to) = self.longest_piece(link, *a, *b);
                    let mut request = ringed(&number, Site::Along { from, to });
                    for (_, a, b) in self.bars.iter().filter(|(l, ..)| *l == link).skip(1) {
                        request = request.or(Site::Along { from: *a, to: *b });
                    }
                    requests.push(request.lived(self.born_link(link)));
                }
                // While the drawing grows, a link of which one joint is there is not there yet.
                None if self.pose.places(link).len() < self.notation.mechanism().link(link).points.len() => {}
                None if !blocked => {
                    if let Some((_, at)) = self.pose.places(link).first() {
                        let slides = &self.notation.mechanism().slides;
                        let rides = slides
                            .iter()
                            .any(|s| matches!(s.rider, Rider::Link { link: l, .. } if l == link));
                        let radius = if rides { 5.0 } else { 2.0 };
                        let site = Site::Around { at: *at, radius, toward: None };
                        requests.push(ringed(&number, site).lived(self.born_link(link)));
                    }
                }
                None => {}
            }
        }
        self.labels.append(&mut requests);
    }

    fn longest_piece(&self, link: LinkId, a: Point, b: Point) -> (Point, Point) {
        let d = b - a;
        // What rides on the link parts it too.
        let slides = self.notation.mechanism().slides.iter().filter(|slide| slide.guide.link == link);
        let riders = slides.filter_map(|slide| self.pose.rider(slide));
        let joints = self.pose.places(link).into_iter().map(|(_, p)| p);
        let mut stops: Vec<f64> = joints
            .chain(riders)
            .filter(|p| (*p - a).cross(d).abs() < THIN * d.hypot())
            .map(|p| (p - a).dot(d) / d.hypot2())
            .chain([0.0, 1.0])
            .filter(|t| (-1e-9..=1.0 + 1e-9).contains(t))
            .collect();
        stops.sort_by(f64::total_cmp);
        let longest = stops.windows(2).max_by(|x, y| (x[1] - x[0]).total_cmp(&(y[1] - y[0] + 1e-9)));
        longest.map_or((a, b), |w| (a.lerp(b, w[0]), a.lerp(b, w[1])))
    }
}

/// A curved arrow's place.
#[derive(Debug, Clone, Copy)]
struct Turn {
    centre: Point,
    radius: f64,
    middle: f64,
    half: f64,
}

pub(super) fn ringed(number: &str, site: Site) -> Request {
    let mut request = Request::new(Rich::upright(number), SMALL * 0.95, site, "label link-number")
        .naming([number.to_owned()]);
    request.ring = Some(if number.len() > 1 { 2.6 } else { 2.1 });
    request.leader = true;
    request
}

fn pitch_circle(centre: Point, radius: f64) -> Mark {
    Mark::stroke(Shape::Circle { centre, radius }, Pen::chain(THIN)).class("pitch-circle").precise()
}

/// The contact of two wheels: a dot on a piece of the common tangent.
fn tangency(group: &mut Group, at: Point, centres: Vec2) {
    let along = Vec2::new(-centres.y, centres.x) * 2.6;
    let tangent = Shape::Line(at - along, at + along);
    group.mark(Mark::stroke(tangent, Pen::solid(THIN)).class("tangency"));
    group.mark(dot(at, 0.6).class("tangency"));
}

/// A curved guide of the frame: its surface outside of the block; for a bare pin both sides of its slot.
fn fixed_arc(at: Point, centre: Point, bare: bool) -> Group {
    let mut own = Group::new("guide");
    let radius = at.distance(centre);
    let d = at - centre;
    let middle = libm::atan2(-d.y, d.x);
    let half = (GUIDE / radius.max(1.0)).min(1.2);
    let sides: &[f64] = if bare { &[BARE, -BARE] } else { &[BLOCK.1] };
    for side in sides {
        let surface = radius + side;
        if surface < 1.0 {
            continue;
        }
        let arc = Shape::Arc { centre, radius: surface, start: middle - half, sweep: 2.0 * half };
        own.mark(Mark::stroke(arc, Pen::solid(THICK)).precise());
        let strokes = (2.0 * half * surface / 1.5).floor().min(MOST_HATCHES);
        for i in 0..strokes as usize {
            let angle = middle - half + (i as f64 + 0.5) * (2.0 * half / strokes);
            let from = on_circle(centre, surface, angle);
            let to = on_circle(centre, (surface + 1.5 * side.signum()).max(0.1), angle - 1.5 / surface);
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("hatch"));
        }
    }
    own
}

pub(super) fn nearest(a: Point, b: Point, p: Point) -> Point {
    let d = b - a;
    let t = ((p - a).dot(d) / d.hypot2().max(1e-12)).clamp(0.0, 1.0);
    a.lerp(b, t)
}
