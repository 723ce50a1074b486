//! On the skeleton of a question: the places that a figure states, the guides and the shapes of links, dimensioned so that
//! a student can lay the mechanism off.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use kurbo::{Point, Rect, Vec2};

use super::dimensions::{CLASS, Distance, Drawn, SHORTEST, TYPE, touched, walk};
use super::figure::{Group, Mark, Pen, Shape, on_circle};
use super::human;
use super::ink::{FINE, HEAD, SMALL, THIN, arc_arrow, arrow, head, right_angle};
use super::labels::{Obstacles, Request, Site};
use super::pose::GuideLine;
use super::rich::Rich;
use super::skeleton::{Artist, BLOCK, PIN, SLOT_BLOCK, nearest};
use super::slots::TOWARD;
use crate::mechanism::quantity::Quantity;
use crate::mechanism::statement::{Locus, Standing};
use crate::mechanism::{
    Direction, Form, Guide, GuidePoint, Input, Link, LinkId, Path, PointId, Rider, Roll, Slide,
};

/// As a scene rounds an angle.
const ROUNDED: f64 = 1e-9;
/// Side of a right-angle mark.
const CORNER: f64 = 2.6;
/// How far beyond the mechanism a place may lie that is drawn for a dimension alone, mm.
const BESIDE: f64 = 30.0;
/// The radii that an angle's arc may have, mm.
const ARCS: [f64; 5] = [8.0, 10.5, 13.0, 16.0, 20.0];

/// An angle to be dimensioned: from one direction to another about a point.
struct Angle {
    vertex: Point,
    /// Radians ccw from the right.
    start: f64,
    /// Radians, ccw positive.
    sweep: f64,
    text: Rich,
    /// Whether its legs need a thin line.
    legs: [bool; 2],
}

/// The direction of a vector of the page, radians ccw from the right.
fn angle_of(way: Vec2) -> f64 {
    libm::atan2(-way.y, way.x)
}

/// The unit vector of the page in a direction.
fn way(angle: f64) -> Vec2 {
    let (sin, cos) = libm::sincos(angle);
    Vec2::new(cos, -sin)
}

/// The angle of a line, which has no sense: in (−π/2, π/2].
fn of_line(angle: f64) -> f64 {
    let own = libm::remainder(angle, PI);
    if own <= -FRAC_PI_2 + ROUNDED { own + PI } else { own }
}

fn is_square(one: Vec2, other: Vec2) -> bool {
    one.dot(other).abs() < 1e-6 * one.hypot() * other.hypot()
}

/// Whether a guide of the frame is level or upright: its distance is dimensioned, not its angle.
pub(super) fn lies_with_axes(direction: Direction, turned: f64) -> bool {
    let Direction::Angle(angle) = direction else { return false };
    let (sin, cos) = libm::sincos(angle.value + turned);
    sin.abs() < ROUNDED || cos.abs() < ROUNDED
}

impl Artist<'_> {
    /// Where dimensions of their own may stand: at the mechanism and a little beside it.
    pub(super) fn near(&self, at: Point) -> bool {
        let places = self.construction.space.places.iter().flatten().map(|at| super::ink::page(*at));
        let own = places.fold(None, |all: Option<Rect>, at| {
            Some(all.map_or(Rect::from_points(at, at), |all| all.union_pt(at)))
        });
        own.is_some_and(|own| own.inflate(BESIDE, BESIDE).contains(at))
    }

    /// Whether ink of a link runs from one place to another.
    fn has_bar(&self, from: Point, to: Point) -> bool {
        self.bars.iter().any(|(_, a, b)| [from, to].iter().all(|p| nearest(*a, *b, *p).distance(*p) < 0.3))
    }

    /// A thin line where no link's line runs.
    fn leg(&self, own: &mut Group, from: Point, to: Point) {
        let d = to - from;
        if d.hypot() > PIN && !self.has_bar(from, to) {
            let from = from + d.normalize() * PIN;
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("extension-line"));
        }
    }

    /// The loci by which the figure states places, but circles, which are distances, and guides, which are dimensioned as such.
    pub(super) fn loci(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles) {
        for statement in &self.notation.mechanism().statements {
            let of = statement.point;
            let Some(at) = self.pose.place(of) else { continue };
            if matches!(statement.standing, Standing::Driven | Standing::Hint) {
                continue;
            }
            for locus in &statement.loci {
                match *locus {
                    Locus::Circle { .. } => {}
                    Locus::Ray { from, direction } => self.ray(all, ink, (from, at), direction.value),
                    Locus::Square { through, to } => self.square(all, ink, (through, at), to),
                    Locus::Sees { ends, angle } => self.seeing(all, ink, (at, ends), angle.value),
                    Locus::On(path) => {
                        let guide = |slide: &Slide| slide.guide.path == path;
                        if !self.notation.mechanism().slides.iter().any(guide) {
                            self.path(all, ink, Guide { link: LinkId::FRAME, path }, at, None);
                        }
                    }
                }
            }
        }
    }

    fn ray(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles, (from, at): (PointId, Point), direction: f64) {
        let Some(vertex) = self.pose.place(from) else { return };
        let sweep = if direction.abs() > TAU { libm::remainder(direction, TAU) } else { direction };
        let text = super::given::degrees(direction, &self.notation);
        let mut line = Group::new("dimension");
        self.leg(&mut line, vertex, at);
        if !line.children.is_empty() {
            ink.extend(&line);
            all.push(Drawn { cost: 0.0, ink: line, text: None, places: None });
        }
        self.angle(all, ink, Angle { vertex, start: 0.0, sweep, text, legs: [true, false] });
    }

    /// A right angle at the foot of a line on another.
    fn square(
        &self,
        all: &mut Vec<Drawn>,
        ink: &mut Obstacles,
        (through, at): (PointId, Point),
        to: [PointId; 2],
    ) {
        let [Some(corner), Some(a), Some(b)] = [through, to[0], to[1]].map(|p| self.pose.place(p)) else {
            return;
        };
        let along = (b - a).normalize();
        let foot = a + along * (corner - a).dot(along);
        let far = if foot.distance(a) > foot.distance(b) { a } else { b };
        let (one, other) = (far - foot, if at.distance(foot) > PIN { at - foot } else { corner - foot });
        if one.hypot() < PIN || other.hypot() < PIN {
            return;
        }
        let mut own = Group::new("dimension angle");
        right_angle(&mut own, foot, one, other, CORNER);
        self.leg(&mut own, foot, at);
        self.leg(&mut own, foot, nearest(a, b, foot));
        self.leg(&mut own, foot, corner);
        ink.extend(&own);
        all.push(Drawn { cost: 0.0, ink: own, text: None, places: None });
    }

    /// The angle at which a segment is seen from a point.
    fn seeing(
        &self,
        all: &mut Vec<Drawn>,
        ink: &mut Obstacles,
        (at, ends): (Point, [PointId; 2]),
        angle: f64,
    ) {
        let [Some(a), Some(b)] = ends.map(|p| self.pose.place(p)) else { return };
        if a.distance(at) < PIN || b.distance(at) < PIN {
            return;
        }
        if (angle.abs() - FRAC_PI_2).abs() < ROUNDED {
            let mut own = Group::new("dimension angle");
            right_angle(&mut own, at, a - at, b - at, CORNER);
            self.leg(&mut own, at, a);
            self.leg(&mut own, at, b);
            ink.extend(&own);
            all.push(Drawn { cost: 0.0, ink: own, text: None, places: None });
            return;
        }
        let legs = [a, b].map(|end| !self.has_bar(at, end));
        let text = human::degrees(angle.abs());
        self.angle(all, ink, Angle { vertex: at, start: angle_of(a - at), sweep: angle, text, legs });
    }

    /// The guides, the rails on the frame, and what is stated of where they lie.
    pub(super) fn guides(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles) {
        let mechanism = self.notation.mechanism();
        for (index, slide) in mechanism.slides.iter().enumerate() {
            let Some(rider) = self.pose.rider(slide) else { continue };
            let driven = mechanism.inputs.iter().find_map(|input| match input {
                Input::Slide { slide, at, .. } if *slide == index => *at,
                _ => None,
            });
            self.path(all, ink, slide.guide, rider, driven.map(|at| at.value));
        }
        for (index, roll) in mechanism.rolls.iter().enumerate() {
            let Roll::Line { guide, .. } = roll else { continue };
            let contact = mechanism.contacts.get(index).and_then(|contact| self.pose.place(*contact));
            if let (LinkId::FRAME, Some(contact)) = (guide.link, contact) {
                self.path(all, ink, *guide, contact, None);
            }
        }
    }

    /// A line or an arc on which something is; `driven` how far along it, where that is stated.
    fn path(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles, guide: Guide, at: Point, driven: Option<f64>) {
        let place = match guide.path {
            Path::Straight { through, .. } => through,
            Path::Arc { centre, .. } => centre,
        };
        let Some(base) = self.pose.stands(guide.link, place) else { return };
        let far = matches!(place, GuidePoint::Point(point) if self.far.contains(&point));
        let near = self.near(base) && !far;
        let (direction, turned, offset) = match guide.path {
            Path::Arc { radius, .. } => {
                if near {
                    self.own_place(all, ink, guide.link, place, base);
                }
                let from = if near { base } else { at + (base - at).normalize() * TOWARD };
                self.radius(all, ink, (from, at), radius.value);
                return;
            }
            Path::Straight { direction, turned, offset, .. } => (direction, turned.value, offset.value),
        };
        let Some((foot, along)) = self.pose.track(guide) else { return };
        let on_frame = guide.link == LinkId::FRAME;
        let with_axes = on_frame && lies_with_axes(direction, turned);
        if near && (!with_axes || driven.is_some()) {
            self.own_place(all, ink, guide.link, place, base);
        }
        if near && on_frame && foot.distance(at) > PIN && (!with_axes || driven.is_some()) {
            let mut own = Group::new("dimension");
            own.mark(Mark::stroke(Shape::Line(foot, at), Pen::chain(FINE)).class("axis"));
            ink.extend(&own);
            all.push(Drawn { cost: 0.0, ink: own, text: None, places: None });
        }
        if near && offset != 0.0 && !with_axes {
            let across = (foot - base).normalize();
            self.length(all, ink, Distance::new(base, foot, across, self.stated(offset.abs())));
        }
        let counted = driven.filter(|own| {
            let told = matches!(place, GuidePoint::Point(_)) && offset == 0.0;
            near && !told && self.pose.paper(own.abs()) > SHORTEST
        });
        if let Some(own) = counted {
            self.length(all, ink, Distance::new(foot, at, along, self.stated(own.abs())));
        }
        if !with_axes {
            self.inclination(all, ink, guide, (if near { foot } else { at }, at), along);
        }
    }

    /// The angle of a straight guide against the axes, or the line, from which it is stated.
    fn inclination(
        &self,
        all: &mut Vec<Drawn>,
        ink: &mut Obstacles,
        guide: Guide,
        (vertex, at): (Point, Point),
        along: Vec2,
    ) {
        let Path::Straight { through, direction, turned, .. } = guide.path else { return };
        let (reference, own) = match direction {
            Direction::Angle(angle) if guide.link == LinkId::FRAME => (0.0, angle.value + turned.value),
            Direction::Angle(angle) => {
                // The own line of a link shows in the figure, where it has one.
                let link = self.notation.mechanism().link(guide.link);
                let shown = matches!(link.form, Form::Length(_) | Form::Line(_));
                let begins = matches!(through, GuidePoint::Point(p) if link.points.first() == Some(&p));
                let Some((_, x)) = self.pose.axes(guide.link).filter(|_| shown && begins) else { return };
                (angle_of(x), angle.value + turned.value)
            }
            Direction::Toward(target) if turned.value != 0.0 => {
                let ends = self.pose.stands(guide.link, through).zip(self.pose.place(target));
                let Some((from, to)) = ends else { return };
                (angle_of(to - from), turned.value)
            }
            Direction::Toward(_) => return,
        };
        let sweep = of_line(own);
        if sweep.abs() < ROUNDED {
            return;
        }
        // On the side of what is on the guide.
        let back = (at - vertex).dot(way(reference + sweep)) < 0.0;
        let start = if back { reference + PI } else { reference };
        let shown = at.distance(vertex) > ARCS[0] || guide.link != LinkId::FRAME;
        if (sweep.abs() - FRAC_PI_2).abs() < ROUNDED && guide.link != LinkId::FRAME {
            let mut mark = Group::new("dimension angle");
            right_angle(&mut mark, vertex, way(start), along, CORNER + SLOT_BLOCK.1);
            ink.extend(&mark);
            all.push(Drawn { cost: 0.0, ink: mark, text: None, places: None });
            return;
        }
        let leg = !self.has_bar(vertex, vertex + way(start) * ARCS[0]);
        let text = human::degrees(sweep.abs());
        self.angle(all, ink, Angle { vertex, start, sweep, text, legs: [leg, !shown] });
    }

    /// A place in own coordinates that no point marks: a small cross, and how far it is from the first point of its link.
    fn own_place(
        &self,
        all: &mut Vec<Drawn>,
        ink: &mut Obstacles,
        link: LinkId,
        place: GuidePoint,
        at: Point,
    ) {
        let GuidePoint::Own(own) = place else { return };
        let mechanism = self.notation.mechanism();
        let (first, from, x) = if link == LinkId::FRAME {
            let fixed = (0..mechanism.points.len()).map(PointId).find(|p| mechanism.is_fixed(*p));
            let exact = fixed.and_then(|p| mechanism.points[p.0].place.exact());
            let Some((from, exact)) = fixed.and_then(|p| self.pose.place(p)).zip(exact) else { return };
            (exact.map(|c| c.value), from, Vec2::new(1.0, 0.0))
        } else {
            let joint = mechanism.link(link).points.first().copied();
            let joint = joint.filter(|joint| mechanism.link(link).has_at_origin(*joint));
            let Some((from, (_, x))) = joint.and_then(|p| self.pose.place(p)).zip(self.pose.axes(link))
            else {
                return;
            };
            ([0.0; 2], from, x)
        };
        let stands = |p: &Point| p.distance(at) < 0.3;
        if !self.construction.space.places.iter().flatten().map(|p| super::ink::page(*p)).any(|p| stands(&p))
        {
            let mut cross = Group::new("dimension");
            for d in [Vec2::new(1.2, 1.2), Vec2::new(1.2, -1.2)] {
                cross.mark(Mark::stroke(Shape::Line(at - d, at + d), Pen::solid(FINE)).class("place"));
            }
            ink.extend(&cross);
            all.push(Drawn { cost: 0.0, ink: cross, text: None, places: None });
        }
        let away = [0, 1].map(|axis| own[axis].value - first[axis]);
        self.along_axes(all, ink, (from, at), x, away);
    }

    /// How far a place is from another along two axes, metres.
    fn along_axes(
        &self,
        all: &mut Vec<Drawn>,
        ink: &mut Obstacles,
        (from, to): (Point, Point),
        x: Vec2,
        away: [f64; 2],
    ) {
        for (length, along) in away.into_iter().zip([x, Vec2::new(x.y, -x.x)]) {
            if self.pose.paper(length.abs()) > SHORTEST {
                self.length(all, ink, Distance::new(from, to, along, self.stated(length.abs())));
            }
        }
    }

    /// The own coordinates of a link's points, from its first point along its own axes.
    pub(super) fn shapes(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles) {
        let mechanism = self.notation.mechanism();
        for id in mechanism.moving() {
            let link = mechanism.link(id);
            let own: Vec<(PointId, [f64; 2])> = own_coordinates(link);
            let Some(&(first, origin)) = own.first() else { continue };
            let Some((from, (_, x))) = self.pose.place(first).zip(self.pose.axes(id)) else { continue };
            for &(point, at) in &own[1..] {
                let Some(to) = self.pose.place(point) else { continue };
                self.along_axes(all, ink, (from, to), x, [at[0] - origin[0], at[1] - origin[1]]);
            }
        }
    }

    /// An arrow from a centre to its arc.
    fn radius(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles, (centre, tip): (Point, Point), radius: f64) {
        if centre.distance(tip) < 2.0 * SHORTEST + HEAD {
            return;
        }
        let mut own = Group::new("dimension radius");
        let d = (tip - centre).normalize();
        own.mark(Mark::stroke(Shape::Line(centre + d * PIN, tip), Pen::solid(FINE)).class("dimension-line"));
        own.mark(head(tip, d, HEAD * 0.8));
        ink.extend(&own);
        let text = Rich::italic("R").up("\u{2009}").then(&self.stated(radius));
        let mut request = Request::new(text, TYPE, Site::Along { from: centre, to: tip }, CLASS);
        request.leader = true;
        all.push(Drawn { cost: 1.0, ink: own, text: Some(request), places: None });
    }

    /// An angle's arc where it disturbs least.
    fn angle(&self, all: &mut Vec<Drawn>, ink: &mut Obstacles, angle: Angle) {
        let Angle { vertex, start, sweep, text, legs } = angle;
        if sweep == 0.0 {
            return;
        }
        let cost = |radius: f64| {
            let pieces = 12;
            let at = |i: usize| on_circle(vertex, radius, start + sweep * i as f64 / f64::from(pieces));
            let arc: f64 = (1..pieces as usize).map(|i| touched(ink, at(i))).sum();
            let reference = walk(vertex + way(start) * PIN, vertex + way(start) * (radius + 3.0), 2.0);
            arc + if legs[0] { 0.5 * reference.map(|p| touched(ink, p)).sum::<f64>() } else { 0.0 }
        };
        let costs = ARCS.into_iter().enumerate().map(|(i, radius)| (cost(radius) + i as f64, radius));
        let Some((cost, radius)) = costs.reduce(|a, b| if b.0 < a.0 { b } else { a }) else { return };
        let mut own = Group::new("dimension angle");
        for (leg, direction) in legs.into_iter().zip([start, start + sweep]) {
            if leg {
                let line =
                    Shape::Line(vertex + way(direction) * PIN, vertex + way(direction) * (radius + 3.0));
                own.mark(Mark::stroke(line, Pen::solid(FINE)).class("extension-line"));
            }
        }
        if sweep.abs() * radius > 1.5 {
            arc_arrow(&mut own, vertex, radius, start, sweep, FINE);
        }
        ink.extend(&own);
        let middle = start + sweep / 2.0;
        let at = on_circle(vertex, radius, middle);
        let mut request =
            Request::new(text, TYPE, Site::Around { at, radius: 0.3, toward: Some(middle) }, CLASS);
        request.leader = true;
        all.push(Drawn { cost, ink: own, text: Some(request), places: None });
    }

    /// The velocities of what is driven along straight guides, as arrows beside their riders, with their names.
    pub(super) fn driven_velocities(&self) -> (Group, Vec<Request>) {
        let mut all = Group::new("rotations");
        let mut names = Vec::new();
        let mechanism = self.notation.mechanism();
        for input in &mechanism.inputs {
            let Input::Slide { slide: index, velocity, .. } = input else { continue };
            let slide = mechanism.slides[*index];
            let (Some(GuideLine::Straight { at, along }), Some(point)) =
                (self.pose.guide(&slide), mechanism.pin_of_slide(*index))
            else {
                continue;
            };
            if velocity.value == 0.0 {
                continue;
            }
            let on_frame = slide.guide.link == LinkId::FRAME;
            let along = along * velocity.value.signum();
            let aside = -self.frame_side(at, along) * (BLOCK.1 + 2.0);
            let (from, to) = (at + aside - along * 5.0, at + aside + along * 5.0);
            let mut own = Group::new("velocity-given");
            arrow(&mut own, from, to, THIN);
            all.group(own);
            let quantity =
                if on_frame { Quantity::Velocity(point) } else { Quantity::Slip(point, slide.guide.link) };
            let text = self.notation.symbol(quantity, false);
            let mut request = Request::new(text, SMALL, Site::Along { from, to }, "label rotation-name");
            request.leader = true;
            names.push(request);
        }
        (all, names)
    }

    /// The right angles between two guides that lead one link: of moving guides at its block, of guides of the frame where
    /// their axes cross.
    pub(super) fn square_guides(&self) -> Group {
        let mut all = Group::new("right-angles");
        let mechanism = self.notation.mechanism();
        for id in mechanism.moving() {
            let link = mechanism.link(id);
            let led: Vec<(&Slide, Point, Vec2)> = mechanism
                .slides
                .iter()
                .filter(|slide| match slide.rider {
                    Rider::Link { link, .. } => link == id,
                    Rider::Pin { point, .. } => {
                        slide.guide.link == LinkId::FRAME && link.points.contains(&point)
                    }
                })
                .filter_map(|slide| match self.pose.guide(slide)? {
                    GuideLine::Straight { at, along } => Some((slide, at, along)),
                    GuideLine::Arc { .. } => None,
                })
                .collect();
            let [(one, at, u), (other, beside, v)] = led[..] else { continue };
            if !is_square(u, v) {
                continue;
            }
            let mut own = Group::default().lived(self.born_link(id));
            let on_frame = [one, other].map(|slide| slide.guide.link == LinkId::FRAME);
            match on_frame {
                [true, true] => self.crossing(&mut own, (at, u), (beside, v)),
                [false, false] if at.distance(beside) < 0.3 => self.corner(&mut own, at, u, v),
                _ => {}
            }
            all.adopt(own);
        }
        all
    }

    /// The axes of two guides run to where they cross square.
    fn crossing(&self, own: &mut Group, (a, u): (Point, Vec2), (b, v): (Point, Vec2)) {
        let corner = a + u * (b - a).dot(u);
        let (one, other) = (a - corner, b - corner);
        if !self.near(corner) || one.hypot() < 2.0 * CORNER || other.hypot() < 2.0 * CORNER {
            return;
        }
        for end in [a, b] {
            own.mark(Mark::stroke(Shape::Line(corner, end), Pen::chain(FINE)).class("axis"));
        }
        right_angle(own, corner, one, other, CORNER);
        debug_assert!(v.cross(u).abs() > 0.5);
    }

    /// A mark between two slots, on the side where no link runs.
    fn corner(&self, own: &mut Group, at: Point, u: Vec2, v: Vec2) {
        let ways = [(u, v), (u, -v), (-u, -v), (-u, v)];
        let free = |(one, other): &(Vec2, Vec2)| {
            let place = at + (*one + *other) * (SLOT_BLOCK.1 + CORNER);
            let off = |(_, a, b): &(LinkId, Point, Point)| nearest(*a, *b, place).distance(place);
            self.bars.iter().map(off).fold(f64::INFINITY, f64::min)
        };
        let best = ways.into_iter().map(|way| (free(&way), way));
        if let Some((_, (one, other))) = best.reduce(|a, b| if b.0 > a.0 + 1e-6 { b } else { a }) {
            let corner = at + (one + other) * SLOT_BLOCK.1;
            right_angle(own, corner, one, other, CORNER);
        }
    }
}

/// The own coordinates of a link's points, metres, as far as its scene states them: all of a shape, further points of
/// another form from its first one.
fn own_coordinates(link: &Link) -> Vec<(PointId, [f64; 2])> {
    match &link.form {
        Form::Shape(places) => {
            let own = link.points.iter().zip(places).map(|(p, at)| (*p, at.map(|c| c.value)));
            own.chain(extra(link)).collect()
        }
        _ => {
            let first = link.points.first().filter(|first| link.has_at_origin(**first));
            first.map(|first| (*first, [0.0; 2])).into_iter().chain(extra(link)).collect()
        }
    }
}

fn extra(link: &Link) -> impl Iterator<Item = (PointId, [f64; 2])> + '_ {
    let own = link.points.iter().enumerate();
    own.filter_map(|(index, point)| Some((*point, link.extra_at(index)?.map(|c| c.value))))
}
