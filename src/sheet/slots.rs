//! Guides on moving links as ink: slots, curved slots, swivelling sleeves, and the blocks in them.

use kurbo::{Point, Vec2};

use super::figure::{Group, Mark, Pen, Shape, Tone, on_circle};
use super::ink::{FINE, HEAD, SMALL, THICK, THIN, dot, head, turned_rect};
use super::labels::{Request, Site};
use super::overlap::part_inside;
use super::pose::GuideLine;
use super::rich::Rich;
use super::skeleton::{Artist, BARE, BLOCK, Body, GUIDE, PIN, SLOT_BLOCK, nearest, ringed};
use crate::mechanism::{GuidePoint, LinkId, Path, PointId, Rider, Slide};

/// Half length and half width of a sleeve in which a rod slides.
const SLEEVE: (f64, f64) = (5.2, 2.2);
/// Where a cylinder begins and ends along its rod, from its pivot.
const CYLINDER: (f64, f64) = (-6.5, 11.0);
/// Where the piston of a rod stands in it that ends nowhere.
const PISTON: f64 = 4.5;
/// How far a cylinder reaches back beyond its piston.
const STROKE: f64 = 4.0;
/// Half length of the tangent under a pin in a curved slot.
const TANGENT: f64 = 5.0;
/// How far the radius of a curved guide runs toward a centre that lies far off.
pub(super) const TOWARD: f64 = 24.0;
/// Half the angle of a step along a curved outline.
const CHORD: f64 = 0.02;

/// A slot as it lies on the paper.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slot {
    /// The link that carries it.
    pub link: LinkId,
    /// Index of its sliding pair.
    pub index: usize,
    /// The two ends of its middle line.
    pub ends: (Point, Point),
    /// The stroke by which it depends on its link, where they do not touch: from the link to the slot.
    pub arm: Option<(Point, Point)>,
    form: SlotForm,
}

impl Slot {
    /// Its middle line.
    pub(super) fn middle_line(&self) -> Shape {
        match self.form {
            SlotForm::Straight(_) => Shape::Line(self.ends.0, self.ends.1),
            SlotForm::Curved { centre, radius, from, to } => {
                Shape::Arc { centre, radius, start: from, sweep: to - from }
            }
        }
    }
}

/// What a rod slides in, lengths along the rod from the joint about which it turns.
#[derive(Debug, Clone, Copy)]
struct Tube {
    near: f64,
    far: f64,
    /// Where the rod ends.
    end: f64,
    /// Whether it ends in a piston.
    piston: bool,
}

/// The open end of a slot: beyond it the pin is free, and what is told of the link holds no more.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Opening {
    /// The pin that runs in it.
    pub pin: PointId,
    /// About this pivot its link turns.
    pub pivot: PointId,
    /// That link.
    pub link: LinkId,
    /// The pin is in it as long as it is no farther from the pivot than this, mm of paper.
    pub reach: f64,
}

/// A Geneva wheel as it lies on the paper, lengths in millimetres.
#[derive(Debug, Clone, Copy)]
struct Geneva {
    centre: Point,
    slots: usize,
    /// From its pivot to that of the crank.
    base: f64,
    /// Of the crank.
    crank: f64,
    /// Of the wheel.
    radius: f64,
}

impl Geneva {
    /// Its outline, beginning with the side of the slot in this direction.
    fn outline(&self, way: Vec2) -> Vec<Point> {
        let step = std::f64::consts::TAU / self.slots as f64;
        let first = libm::atan2(-way.y, way.x);
        let bottom = (self.base - self.crank - BARE).max(PIN + 1.0);
        let lock = 0.8 * self.crank;
        // Where the hollow for the crank's disc cuts the rim, from the middle between two slots.
        let cut = (self.base * self.base + self.radius * self.radius - lock * lock)
            / (2.0 * self.base * self.radius);
        let cut = libm::acos(cut.clamp(-1.0, 1.0));
        let mut all = Vec::new();
        // No chord leaves its arc by as much as a thin line is wide.
        let rim = |from: f64, to: f64| {
            (1..16)
                .map(move |i| on_circle(self.centre, self.radius, from + (to - from) * f64::from(i) / 16.0))
        };
        let mouth = libm::asin((BARE / self.radius).clamp(0.0, 1.0));
        for k in 0..self.slots {
            let along = first + step * k as f64;
            let (sin, cos) = libm::sincos(along);
            let (out, left) = (Vec2::new(cos, -sin), Vec2::new(-sin, -cos));
            let open = self.radius * libm::cos(mouth);
            let at = |r: f64, side: f64| self.centre + out * r + left * (side * BARE);
            all.extend([at(open, -1.0), at(bottom, -1.0)]);
            for i in 1..8 {
                let (sin, cos) = libm::sincos(std::f64::consts::PI * f64::from(i) / 8.0);
                all.push(at(bottom, -cos) - out * (BARE * sin));
            }
            all.extend([at(bottom, 1.0), at(open, 1.0)]);
            // The rim to the hollow, the hollow, and the rim to the next slot.
            let middle = along + step / 2.0;
            let disc = on_circle(self.centre, self.base, middle);
            let edge = [middle - cut, middle + cut].map(|angle| on_circle(self.centre, self.radius, angle));
            let seen = |p: Point| libm::atan2(disc.y - p.y, p.x - disc.x);
            let (from, to) = (seen(edge[0]), seen(edge[1]));
            let sweep = libm::remainder(to - from, std::f64::consts::TAU);
            all.extend(rim(along + mouth, middle - cut));
            all.extend((0..=48).map(|i| on_circle(disc, lock, from + sweep * f64::from(i) / 48.0)));
            all.extend(rim(middle + cut, along + step - mouth));
        }
        all
    }
}

#[derive(Debug, Clone, Copy)]
enum SlotForm {
    /// Along this direction.
    Straight(Vec2),
    /// About this centre, with this radius, between these angles.
    Curved { centre: Point, radius: f64, from: f64, to: f64 },
}

impl Artist<'_> {
    /// The points of a link that are nothing but the centre of one of its curved slots.
    pub(super) fn slot_centres(&self, link: LinkId) -> Vec<PointId> {
        let mechanism = self.notation.mechanism();
        let own = mechanism.slides.iter().filter(|s| s.guide.link == link && link != LinkId::FRAME);
        let centres = own.filter_map(|s| match s.guide.path {
            Path::Arc { centre: GuidePoint::Point(p), .. } => Some(p),
            _ => None,
        });
        centres.filter(|p| !mechanism.pins.iter().any(|pin| pin.point == *p)).collect()
    }

    /// Whether a slot runs along a link's own line: then it stands for the bar.
    pub(super) fn is_slotted(&self, link: LinkId) -> bool {
        self.notation.mechanism().slides.iter().filter(|s| s.guide.link == link).any(|slide| {
            let Some(GuideLine::Straight { at, along }) = self.pose.guide(slide) else { return false };
            let places = self.pose.places(link);
            places.iter().filter(|(_, p)| (*p - at).cross(along).abs() < THIN).count() >= 2
        })
    }

    /// Whether the guide is a sleeve on the only joint of its link, through which a rod slides.
    pub(super) fn is_sleeve(&self, slide: &Slide) -> bool {
        let Rider::Link { .. } = slide.rider else { return false };
        slide.guide.link != LinkId::FRAME && matches!(self.body(slide.guide.link), Body::Point)
    }

    /// The slots in moving links; `bars` are the strokes of the links without them.
    pub(super) fn all_slots(&self, bars: &[(LinkId, Point, Point)]) -> Vec<Slot> {
        let slides = self.notation.mechanism().slides.iter().enumerate();
        let moving = slides.filter(|(_, s)| s.guide.link != LinkId::FRAME && !self.is_sleeve(s));
        moving.filter_map(|(index, slide)| self.slot(index, slide, bars)).collect()
    }

    fn slot(&self, index: usize, slide: &Slide, bars: &[(LinkId, Point, Point)]) -> Option<Slot> {
        let link = slide.guide.link;
        let (ends, form) = match self.pose.guide(slide)? {
            GuideLine::Straight { at, along } => {
                let mut reach = (-8.0_f64, 8.0_f64);
                for (_, p) in self.pose.places(link) {
                    if (p - at).cross(along).abs() < THIN {
                        let position = (p - at).dot(along);
                        // The slot ends around its joints, not on them.
                        let end = PIN + 0.9;
                        reach = (reach.0.min(position - end), reach.1.max(position + end));
                    }
                }
                // A face runs on to the foot of the stem on which it sits, which then stands square on it.
                if let [(_, joint)] = self.pose.places(link)[..] {
                    let (foot, off) = ((joint - at).dot(along), (joint - at).cross(along).abs());
                    if off > SLOT_BLOCK.1 && foot.abs() < off {
                        reach = (reach.0.min(foot - BARE), reach.1.max(foot + BARE));
                    }
                }
                ((at + along * reach.0, at + along * reach.1), SlotForm::Straight(along))
            }
            GuideLine::Arc { at, centre } => {
                let radius = at.distance(centre);
                let d = at - centre;
                let middle = libm::atan2(-d.y, d.x);
                let half = (GUIDE / radius.max(1.0)).min(1.2);
                let (from, to) = (middle - half, middle + half);
                let ends = (on_circle(centre, radius, from), on_circle(centre, radius, to));
                (ends, SlotForm::Curved { centre, radius, from, to })
            }
        };
        let arm = self.slot_arm(link, ends, bars);
        Some(Slot { link, index, ends, arm, form })
    }

    /// The shortest stroke from a link to its slot; none where they touch.
    fn slot_arm(
        &self,
        link: LinkId,
        (a, b): (Point, Point),
        bars: &[(LinkId, Point, Point)],
    ) -> Option<(Point, Point)> {
        let centres = self.slot_centres(link);
        let joints =
            self.pose.places(link).into_iter().filter(|(p, _)| !centres.contains(p)).map(|(_, at)| at);
        let mut strokes: Vec<(Point, Point)> =
            bars.iter().filter(|(l, ..)| *l == link).map(|s| (s.1, s.2)).collect();
        strokes.extend(joints.map(|at| (at, at)));
        let mut best: Option<(Point, Point)> = None;
        for (p, q) in strokes {
            if crosses((p, q), (a, b)) {
                return None;
            }
            let ways =
                [(p, nearest(a, b, p)), (q, nearest(a, b, q)), (nearest(p, q, a), a), (nearest(p, q, b), b)];
            for way in ways {
                if best.is_none_or(|(from, to)| way.0.distance(way.1) < from.distance(to)) {
                    best = Some(way);
                }
            }
        }
        best.filter(|(from, to)| from.distance(*to) > SLOT_BLOCK.1)
    }

    /// The slots in moving links, closed at their ends, over what lies below them.
    pub(super) fn slots(&mut self) -> Group {
        let mut all = Group::new("slots");
        for (index, slide) in self.notation.mechanism().slides.iter().enumerate() {
            if self.is_sleeve(slide) {
                all.group(self.sleeve(index, slide));
            }
        }
        for slot in &self.slots {
            let number = self.notation.number(slot.link);
            if let Some((from, to)) = slot.arm {
                let mut own =
                    Group::new("link arm").data("link", number.clone()).lived(self.born_guide(slot.index));
                own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(THICK)).class("bar"));
                all.group(own);
            }
            let mut own = Group::new("link slot").data("link", number).lived(self.born_guide(slot.index));
            match slot.form {
                SlotForm::Straight(along) => {
                    own = own.data("guide", self.notation.guide_data(slot.index));
                    if let Some(wheel) = self.geneva(slot.index) {
                        let way = if (slot.ends.1 - wheel.centre).dot(along)
                            > (wheel.centre - slot.ends.0).dot(along)
                        {
                            along
                        } else {
                            -along
                        };
                        let outline = Shape::Polygon(wheel.outline(way));
                        own.mark(Mark::stroke(outline, Pen::solid(THICK)).class("wheel").precise());
                        all.group(own);
                        continue;
                    }
                    let across = Vec2::new(-along.y, along.x) * (SLOT_BLOCK.1 + THIN / 2.0);
                    let (a, b) = slot.ends;
                    let outline = Shape::Polygon(vec![a + across, b + across, b - across, a - across]);
                    own.mark(Mark::outlined(outline, Pen::solid(THICK), Tone::Paper).precise());
                }
                SlotForm::Curved { centre, radius, from, to } => {
                    let steps = ((to - from) / CHORD).ceil().clamp(2.0, 200.0) as usize;
                    let at = |offset: f64, i: usize| {
                        let angle = from + (to - from) * (i as f64 / steps as f64);
                        on_circle(centre, (radius + offset).max(0.1), angle)
                    };
                    let inner = (0..=steps).map(|i| at(-SLOT_BLOCK.1, i));
                    let outer = (0..=steps).rev().map(|i| at(SLOT_BLOCK.1, i));
                    let outline = Shape::Polygon(inner.chain(outer).collect());
                    own.mark(Mark::area(outline, Tone::Paper));
                    for offset in [-SLOT_BLOCK.1, SLOT_BLOCK.1] {
                        let radius = (radius + offset).max(0.1);
                        let side = Shape::Arc { centre, radius, start: from, sweep: to - from };
                        own.mark(Mark::stroke(side, Pen::solid(THICK)).precise());
                    }
                    for end in [0, steps] {
                        let cap = Shape::Line(at(-SLOT_BLOCK.1, end), at(SLOT_BLOCK.1, end));
                        own.mark(Mark::stroke(cap, Pen::solid(THICK)));
                    }
                }
            }
            all.group(own);
        }
        // The radius of a curved slot, where its centre is on the paper.
        let window = self.window();
        for slide in &self.notation.mechanism().slides {
            let (Path::Arc { centre, radius }, Some(GuideLine::Arc { at: rider, centre: middle })) =
                (slide.guide.path, self.pose.guide(slide))
            else {
                continue;
            };
            let born = self.born_rider(slide);
            // A centre that no point marks has a dot of its own; one that lies far off is only pointed to.
            let own = matches!(centre, GuidePoint::Own(_));
            let named = match centre {
                GuidePoint::Point(point) if self.far.contains(&point) => Some(point),
                _ => None,
            };
            let far = named.is_some() || own && !self.near(middle);
            if own && !far {
                all.mark_lived(dot(middle, 0.5).class("centre"), born);
            }
            let middle = if far { rider + (middle - rider).normalize() * TOWARD } else { middle };
            if let Some((centre, rider)) = part_inside(middle, rider, window) {
                let axis = Mark::stroke(Shape::Line(centre, rider), Pen::chain(FINE)).class("axis");
                all.mark_lived(axis, born);
            }
            if let Some(point) = named {
                let way = (middle - rider).normalize();
                all.mark_lived(head(middle, way, HEAD * 0.8), born);
                let radius = super::given::stated_with_unit(radius.value, &self.notation);
                let parts = [("centre", self.notation.point(point)), ("radius", radius)];
                let text = Rich::fill(self.notation.words.to_centre, &parts);
                let site = Site::Around { at: middle, radius: 0.6, toward: Some(libm::atan2(-way.y, way.x)) };
                let mut request = Request::new(text, SMALL, site, "label dimension").lived(born);
                request.leader = true;
                self.labels.push(request);
            }
        }
        all
    }

    /// A sleeve on the frame's or another link's joint, and the rod that runs on through it.
    fn sleeve(&mut self, index: usize, slide: &Slide) -> Group {
        let number = self.notation.number(slide.guide.link);
        let mut own = Group::new("link slider").data("link", number.clone());
        own = own.data("guide", self.notation.guide_data(index));
        let Some(GuideLine::Straight { at, along }) = self.pose.guide(slide) else { return own };
        let Some((_, joint)) = self.pose.places(slide.guide.link).first().copied() else { return own };
        let born = self.born_guide(index);
        own = own.lived(born);
        let (middle, way) = about(joint, at, along);
        let Tube { near, far, end, piston } = self.tube(slide, middle, way);
        let size = (far - near) / 2.0;
        let tube = Shape::Polygon(turned_rect(middle + way * (near + size), along, size, SLEEVE.1));
        own.mark(Mark::outlined(tube, Pen::solid(THICK * 0.8), Tone::Paper).precise());
        let rod = Shape::Line(at, middle + way * end);
        own.mark(Mark::stroke(rod, Pen::solid(THICK)).class("bar"));
        if piston {
            let piston = turned_rect(middle + way * (end + 0.8), along, 0.8, SLEEVE.1 - 0.4);
            own.mark(Mark::area(Shape::Polygon(piston), Tone::Ink).class("piston"));
        }
        let radius = libm::hypot(SLEEVE.0, SLEEVE.1) * 0.8;
        self.labels.push(ringed(&number, Site::Around { at: middle, radius, toward: None }).lived(born));
        own
    }

    /// The middle lines of what rods slide in about joints, by its link.
    pub(super) fn tubes(&self) -> Vec<(LinkId, Point, Point)> {
        let slides = self.notation.mechanism().slides.iter().filter(|slide| self.is_sleeve(slide));
        let tubes = slides.filter_map(|slide| {
            let Some(GuideLine::Straight { at, along }) = self.pose.guide(slide) else { return None };
            let (_, joint) = self.pose.places(slide.guide.link).first().copied()?;
            let (middle, way) = about(joint, at, along);
            let Tube { near, far, .. } = self.tube(slide, middle, way);
            Some((slide.guide.link, middle + way * near, middle + way * far))
        });
        tubes.collect()
    }

    /// What a rod slides in about a joint, the rod coming from behind: a rod that runs on beyond it has a sleeve, one that ends
    /// on this side is a piston's, and the sleeve its cylinder, closed beyond; it reaches back to the piston.
    fn tube(&self, slide: &Slide, middle: Point, way: Vec2) -> Tube {
        let through = Tube { near: -SLEEVE.0, far: SLEEVE.0, end: SLEEVE.0 + 5.0, piston: false };
        let Rider::Link { link, .. } = slide.rider else { return through };
        let ends = self.pose.places(link);
        let tip = ends.iter().map(|(_, p)| (*p - middle).dot(way)).fold(f64::NEG_INFINITY, f64::max);
        if tip > SLEEVE.0 {
            return through;
        }
        let (near, far) = CYLINDER;
        // A rod that is stated from the joint to the side away from it ends on this side nowhere.
        let first = ends.first().map_or(tip, |(_, p)| (*p - middle).dot(way));
        if first >= tip - PIN {
            return Tube { near, far, end: PISTON, piston: true };
        }
        if tip >= near + STROKE {
            return Tube { near, far, end: tip, piston: true };
        }
        Tube { near: tip - STROKE, far: SLEEVE.1, end: tip, piston: true }
    }

    /// The wheel of a Geneva drive: a link with nothing but its pivot and a slot through it, in which a crank's bare pin runs,
    /// the crank as long as `n` slots at even angles ask for.
    fn geneva(&self, index: usize) -> Option<Geneva> {
        let mechanism = self.notation.mechanism();
        let slide = mechanism.slides.get(index)?;
        let Rider::Pin { point: pin, block: None } = slide.rider else { return None };
        let Path::Straight { through: GuidePoint::Point(pivot), offset, .. } = slide.guide.path else {
            return None;
        };
        let only_pivot = mechanism.link(slide.guide.link).points[..] == [pivot];
        if !only_pivot || !mechanism.is_fixed(pivot) || offset.value != 0.0 {
            return None;
        }
        let carries = |link: &LinkId| mechanism.link(*link).points.contains(&pin);
        let crank = mechanism.moving().find(carries)?;
        let shaft = mechanism.link(crank).points.iter().copied().find(|p| mechanism.is_fixed(*p))?;
        let [centre, shaft, pin] = [pivot, shaft, pin].map(|p| self.pose.place(p));
        let (centre, shaft, pin) = (centre?, shaft?, pin?);
        let (base, crank) = (centre.distance(shaft), shaft.distance(pin));
        let ratio = crank / base;
        if !(ratio > 0.0 && ratio < 1.0) {
            return None;
        }
        let slots = (std::f64::consts::PI / libm::asin(ratio)).round();
        let half = std::f64::consts::PI / slots;
        // As a scene rounds it.
        let fits = (libm::sin(half) - ratio).abs() < 1e-4 && (3.0..=12.0).contains(&slots);
        let radius = base * libm::cos(half);
        let engaged = centre.distance(pin) <= radius + BARE;
        (fits && engaged).then_some(Geneva { centre, slots: slots as usize, base, crank, radius })
    }

    /// The pins that a slot lets go: how far from the pivot of the slot's link each may be.
    pub(super) fn openings(&self) -> Vec<Opening> {
        let slides = &self.notation.mechanism().slides;
        let opening = |(index, slide): (usize, &Slide)| {
            let wheel = self.geneva(index)?;
            let (Rider::Pin { point, .. }, link) = (slide.rider, slide.guide.link) else { return None };
            let pivot = *self.notation.mechanism().link(link).points.first()?;
            Some(Opening { pin: point, pivot, link, reach: wheel.radius })
        };
        slides.iter().enumerate().filter_map(opening).collect()
    }

    /// The blocks and sliders: those on the frame, or those in moving guides.
    pub(super) fn slides(&mut self, on_frame: bool) -> Group {
        let mut all = Group::new("sliders");
        for (index, slide) in self.notation.mechanism().slides.iter().enumerate() {
            if (slide.guide.link == LinkId::FRAME) != on_frame || self.is_sleeve(slide) {
                continue;
            }
            let block = match slide.rider {
                Rider::Pin { block: Some(block), .. } => Some(block),
                Rider::Pin { block: None, .. } => None,
                Rider::Link { link, .. } => Some(link),
            };
            let (at, along) = match self.pose.guide(slide) {
                Some(GuideLine::Straight { at, along }) => (at, along),
                Some(GuideLine::Arc { at, centre }) if at.distance(centre) > 0.0 => {
                    let out = (at - centre).normalize();
                    (at, Vec2::new(-out.y, out.x))
                }
                _ => continue,
            };
            // The direction of a curved guide is that of its block, else a piece of its tangent.
            let curved = matches!(slide.guide.path, Path::Arc { .. });
            let guide = curved.then(|| self.notation.guide_data(index));
            let Some(block) = block else {
                if let Some(guide) = guide {
                    let mut own = Group::new("tangent").data("guide", guide).lived(self.born_rider(slide));
                    let shape = Shape::Line(at - along * TANGENT, at + along * TANGENT);
                    own.mark(Mark::stroke(shape, Pen::solid(FINE)).precise());
                    all.group(own);
                }
                continue;
            };
            let size = if on_frame { BLOCK } else { SLOT_BLOCK };
            let number = self.notation.number(block);
            let born = self.born_rider(slide);
            let mut own = Group::new("link slider").data("link", number.clone()).lived(born);
            if let Some(guide) = guide {
                own = own.data("guide", guide);
            }
            let corners = Shape::Polygon(turned_rect(at, along, size.0, size.1));
            own.mark(Mark::outlined(corners, Pen::solid(THICK * 0.8), Tone::Paper).precise());
            // A rider that is a link of its own is welded to its block.
            if matches!(slide.rider, Rider::Link { .. }) {
                own.mark(dot(at, 0.6));
            }
            all.group(own);
            if !matches!(slide.rider, Rider::Link { .. }) {
                let radius = libm::hypot(size.0, size.1) * 0.8;
                let toward = on_frame.then(|| -self.frame_side(at, along));
                let toward = toward.map(|way| libm::atan2(-way.y, way.x));
                self.labels.push(ringed(&number, Site::Around { at, radius, toward }).lived(born));
            }
        }
        all
    }
}

/// The foot of a joint on the line of a rod, and the way there along it.
fn about(joint: Point, at: Point, along: Vec2) -> (Point, Vec2) {
    let middle = at + along * (joint - at).dot(along);
    (middle, if (middle - at).dot(along) < 0.0 { -along } else { along })
}

/// Whether two strokes meet between their ends.
fn crosses((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p);
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
