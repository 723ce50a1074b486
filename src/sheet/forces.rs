//! Free bodies and force polygons as ink: every link cut free with what acts on it, and beside it the polygon of its
//! forces, laid off from the pole.

use kurbo::{Point, Rect, Vec2};

use super::figure::{Dash, Group, Mark, Pen, Shape, Tone};
use super::friction;
use super::human;
use super::ink::{FINE, LABEL, SMALL, THICK, THIN, arc_arrow, arrow, dot, page};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::rich::Rich;
use super::skeleton::{self, Arrows, Overlay};
use super::steps::Item;
use crate::graphical::construction::{Acting, Construction, ForceSheet, FreeBody, FrictionAxis, Knowledge};
use crate::mechanism::LinkId;
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::Quantity;

/// Room for the largest polygon, mm.
const POLYGON: f64 = 62.0;
/// Lengths of arrows of free bodies, mm: they tell where and whither, the polygon how much.
const ARROWS: (f64, f64) = (9.0, 20.0);
/// A force shorter than this on its polygon is a point, mm.
const SHORTEST: f64 = 0.5;
/// Vectors shorter than this have no room for their name.
const SHORTEST_NAMED: f64 = 3.0;
/// Half the length of a line of which nothing but the line is known, mm.
const LINE: f64 = 11.0;
/// Steps of the scale.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// A drawing of the forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ForcePanel {
    /// The skeleton with what is given, weights and inertia.
    Loads,
    /// A free body, by its place in the order of solution.
    Body(usize),
    /// Its polygon.
    Polygon(usize),
    /// Everything from outside.
    Whole,
    /// The inertia forces and their sum.
    Shaking,
    /// A pair that rubs, enlarged, by its place among those that do.
    Friction(usize),
}

impl ForcePanel {
    /// What a sheet of forces has, in order.
    #[must_use]
    pub fn all(sheet: &ForceSheet) -> Vec<Self> {
        let mut all = Vec::new();
        if !given(sheet).is_empty() {
            all.push(Self::Loads);
        }
        for (index, body) in sheet.bodies.iter().enumerate() {
            all.push(Self::Body(index));
            if chain(&body.acting).is_some() {
                all.push(Self::Polygon(index));
            }
        }
        all.extend(friction::panels(sheet).map(Self::Friction));
        if chain(&sheet.whole).is_some() {
            all.push(Self::Whole);
        }
        if !sheet.inertia.is_empty() && chain(&sheet.inertia).is_some() {
            all.push(Self::Shaking);
        }
        all
    }

    /// The name of the figure in which it stands.
    #[must_use]
    pub fn belongs_to(self, name: &str, sheet: &ForceSheet, notation: &Notation<'_>) -> bool {
        let link = |index: usize| sheet.bodies.get(index).map(|body| notation.number(body.link));
        match (self, name) {
            (_, "forces") | (Self::Loads, "loads") | (Self::Shaking, "shaking") => true,
            (Self::Body(_), "bodies") | (Self::Polygon(_), "polygons") | (Self::Whole, "polygon(all)") => {
                true
            }
            (Self::Friction(index), name) => {
                let point = friction::point(index, sheet, notation.mechanism());
                name == "friction" || point.is_some_and(|point| name == format!("friction({point})"))
            }
            (Self::Body(index), name) => link(index).is_some_and(|link| name == format!("body({link})")),
            (Self::Polygon(index), name) => {
                link(index).is_some_and(|link| name == format!("polygon({link})"))
            }
            _ => false,
        }
    }

    /// Its title.
    #[must_use]
    pub fn title(self, sheet: &ForceSheet, notation: &Notation<'_>) -> Rich {
        let words = notation.words;
        let link = |index: usize| {
            let number = sheet.bodies.get(index).map(|body| notation.number(body.link)).unwrap_or_default();
            [("link", Rich::upright(number))]
        };
        match self {
            Self::Loads => Rich::upright(words.loads_figure),
            Self::Body(index) => Rich::fill(words.free_body_figure, &link(index)),
            Self::Polygon(index) => Rich::fill(words.force_polygon_figure, &link(index)),
            Self::Whole => Rich::upright(words.outer_forces_figure),
            Self::Shaking => Rich::upright(words.shaking_figure),
            Self::Friction(index) => friction::title(index, sheet, notation),
        }
    }

    /// Its scale: newtons for the polygons, the skeleton's for what stands on it.
    #[must_use]
    pub fn scale(self, sheet: &ForceSheet, notation: &Notation<'_>) -> Option<Rich> {
        match self {
            Self::Friction(index) => friction::scale(index, sheet, notation),
            Self::Polygon(_) | Self::Whole | Self::Shaking => {
                let unit = &notation.scene.units.force;
                let value = human::with_unit(&human::stated(per_mm(sheet) * 10.0 / unit.si), &unit.symbol);
                Some(value.up("\u{a0}≡\u{a0}1\u{a0}cm"))
            }
            Self::Loads | Self::Body(_) => None,
        }
    }

    /// Its ink.
    #[must_use]
    pub fn draw(
        self,
        sheet: &ForceSheet,
        construction: &Construction,
        notation: &Notation<'_>,
    ) -> Option<Group> {
        match self {
            Self::Friction(index) => friction::draw(index, sheet, notation),
            Self::Loads => Some(loads(sheet, construction, notation)),
            Self::Body(index) => Some(body(sheet.bodies.get(index)?, sheet, construction, notation)),
            Self::Polygon(index) => {
                let body = sheet.bodies.get(index)?;
                let pole = Rich::italic("o").sub(&format!("{}f", notation.number(body.link)));
                Some(polygon(&body.acting, None, &pole, sheet, notation))
            }
            Self::Whole => Some(polygon(&sheet.whole, None, &Rich::italic("o").sub("f"), sheet, notation)),
            Self::Shaking => {
                let sum = Quantity::Force(Force::Vector(Action::Shaking), Share::Total);
                Some(polygon(&sheet.inertia, Some(sum), &Rich::italic("o").sub("f"), sheet, notation))
            }
        }
    }
}

/// The places of a polygon in newtons, from the pole; none where nothing has a size.
fn chain(acting: &[Acting]) -> Option<Vec<[f64; 2]>> {
    let mut at = [0.0; 2];
    let mut places = vec![at];
    for force in acting.iter().map(|acting| acting.force) {
        at = [at[0] + force[0], at[1] + force[1]];
        places.push(at);
    }
    let longest = acting.iter().map(|a| libm::hypot(a.force[0], a.force[1])).fold(0.0, f64::max);
    (longest > 0.0).then_some(places)
}

fn extent(places: &[[f64; 2]]) -> f64 {
    let side = |axis: usize| {
        let all = || places.iter().map(|p| p[axis]);
        all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
    };
    side(0).max(side(1))
}

/// Newtons per millimetre: one scale for all polygons of a sheet.
#[must_use]
fn per_mm(sheet: &ForceSheet) -> f64 {
    let polygons = sheet.bodies.iter().map(|body| &body.acting[..]).chain([&sheet.whole[..], &sheet.inertia]);
    let largest = polygons.filter_map(chain).map(|places| extent(&places)).fold(0.0, f64::max);
    let least = largest / POLYGON;
    // Per centimetre a round number of newtons.
    let least = least * 10.0;
    let power = libm::pow(10.0, libm::floor(libm::log10(least)));
    let round = STEPS.iter().map(|step| step * power).chain([10.0 * power]).find(|scale| *scale >= least);
    round.filter(|scale| scale.is_normal()).unwrap_or(10.0) / 10.0
}

/// What is given and what follows from the motion.
fn given(sheet: &ForceSheet) -> Vec<Acting> {
    let mut all: Vec<Acting> = Vec::new();
    for acting in sheet.bodies.iter().flat_map(|body| &body.acting) {
        let is_given = matches!(
            acting.action,
            Action::Load(_) | Action::Weight(_) | Action::Inertia(_) | Action::Spring { .. }
        );
        if is_given && all.iter().all(|other| other.action != acting.action) {
            all.push(*acting);
        }
    }
    all
}

fn largest(acting: &[Acting]) -> f64 {
    acting.iter().map(|a| libm::hypot(a.force[0], a.force[1])).fold(0.0, f64::max)
}

pub(super) fn symbol(action: Action, notation: &Notation<'_>) -> Rich {
    notation.symbol(Quantity::Force(Force::Vector(action), Share::Total), false)
}

/// An arrow at a place, whose length only hints at the size.
fn short_arrow(
    group: &mut Group,
    requests: &mut Vec<Request>,
    acting: &Acting,
    at: Point,
    most: f64,
    notation: &Notation<'_>,
) {
    let size = libm::hypot(acting.force[0], acting.force[1]);
    if size <= 0.0 {
        return;
    }
    let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
    let length = ARROWS.0 + (ARROWS.1 - ARROWS.0) * size / most;
    let to = at + along * length;
    let unit = &notation.scene.units.force;
    let mut own = Group::new("force applied")
        .data("quantity", acting.action.name(notation.mechanism()))
        .data("value", format!("{}", size / unit.si));
    arrow(&mut own, at, to, THICK);
    group.group(own);
    let text = symbol(acting.action, notation);
    let mut request = Request::new(
        text,
        SMALL,
        Site::Around { at: to, radius: 1.0, toward: Some(libm::atan2(-along.y, along.x)) },
        "label force-name",
    );
    request = request.or(Site::Along { from: at, to });
    request.leader = true;
    requests.push(request);
}

/// Metres from the skeleton's origin as a place of the page.
fn on_page(metres: [f64; 2], construction: &Construction) -> Point {
    page(metres.map(|m| m / construction.space.metres_per_mm))
}

/// The skeleton with the forces that are given, the lines of inertia at their offsets.
fn loads(sheet: &ForceSheet, construction: &Construction, notation: &Notation<'_>) -> Group {
    let mut bare = construction.clone();
    bare.space.lines.clear();
    bare.others.clear();
    let all = given(sheet);
    let most = largest(&all);
    skeleton::draw_under(&bare, notation, Arrows::Inputs, None, |_, _| {
        let mut overlay = Overlay { ink: Group::new("forces"), ..Overlay::default() };
        for link in notation.mechanism().moving() {
            friction::circles_on(&mut overlay.ink, link, sheet, construction, notation);
        }
        for acting in &all {
            let (at, through) = (on_page(acting.at, construction), on_page(acting.through, construction));
            if at.distance(through) > 1.0 {
                // h, from the mass centre to the line of its inertia force.
                let mut offset = Group::new("arm");
                offset.mark(
                    Mark::stroke(Shape::Line(at, through), Pen { width: FINE, dash: Dash::Dashed }).precise(),
                );
                overlay.ink.group(offset);
                if let Action::Inertia(link) = acting.action {
                    let h = notation.symbol(Quantity::Force(Force::Offset(link), Share::Total), false);
                    let mut request =
                        Request::new(h, SMALL, Site::Along { from: at, to: through }, "label arm-name");
                    request.leader = true;
                    overlay.labels.push(request);
                }
            }
            short_arrow(&mut overlay.ink, &mut overlay.labels, acting, through, most, notation);
            if let (Action::Inertia(link), true) = (acting.action, acting.with_couple) {
                let torque = Force::InertiaTorque(link);
                if let Some(value) = couple_of(sheet, link) {
                    turning(
                        &mut overlay.ink,
                        &mut overlay.labels,
                        (torque, value, true),
                        (at, 4.5),
                        notation,
                    );
                }
            }
        }
        overlay
    })
}

/// A link cut free.
fn body(body: &FreeBody, sheet: &ForceSheet, construction: &Construction, notation: &Notation<'_>) -> Group {
    let mut group = Group::new("free-body").data("link", notation.number(body.link));
    let mut requests: Vec<Request> = Vec::new();
    let mechanism = notation.mechanism();
    let places: Vec<(Point, Rich, bool)> = mechanism
        .link(body.link)
        .points
        .iter()
        .filter_map(|point| {
            let at = (*construction.space.places.get(point.0)?)?;
            Some((page(at), notation.point(*point), mechanism.is_pin(*point)))
        })
        .collect();
    draw_link(&mut group, body.link, &places, notation);
    for (at, name, _) in &places {
        requests.push(Request::new(
            name.clone(),
            LABEL,
            Site::Around { at: *at, radius: 1.2, toward: None },
            "label point-name",
        ));
    }
    friction::circles_on(&mut group, body.link, sheet, construction, notation);
    let everything: Vec<Acting> = sheet.bodies.iter().flat_map(|body| body.acting.clone()).collect();
    let most = largest(&everything);
    for acting in &body.acting {
        let at = on_page(acting.through, construction);
        let size = libm::hypot(acting.force[0], acting.force[1]);
        match acting.known {
            Knowledge::Full => short_arrow(&mut group, &mut requests, acting, at, most, notation),
            Knowledge::Line if size > 0.0 => {
                let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
                let (from, to) = (at - along * LINE * 0.5, at + along * LINE);
                let mut own = Group::new("force line").data("quantity", acting.action.name(mechanism));
                own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(THIN)).precise());
                group.group(own);
                named(&mut requests, acting, to, along, notation);
            }
            Knowledge::Line | Knowledge::Nothing => {
                // Away from the middle of the link, where there is room.
                let middle = places.iter().fold(Vec2::ZERO, |sum, (p, ..)| sum + p.to_vec2())
                    / places.len().max(1) as f64;
                let away = at.to_vec2() - middle;
                let mut along = if away.hypot() > 1.0 { away.normalize() } else { Vec2::new(1.0, 0.0) };
                // Not along the link itself.
                let covered = places.iter().any(|(p, ..)| {
                    let to = *p - at;
                    to.hypot() > 1.0 && to.normalize().dot(along) > 0.9
                });
                if covered {
                    along = Vec2::new(-along.y, along.x);
                }
                let mut own = Group::new("force unknown").data("quantity", acting.action.name(mechanism));
                own.mark(Mark::stroke(Shape::Polyline(wave(at, along)), Pen::solid(THIN)));
                group.group(own);
                named(&mut requests, acting, at + along * LINE, along, notation);
            }
        }
    }
    let ink = group.bounds().unwrap_or(Rect::ZERO);
    for (index, (torque, value)) in body.torques.iter().enumerate() {
        let at = places.first().map_or(ink.center(), |(at, ..)| *at);
        let radius = 4.5 + 1.8 * index as f64;
        let known = !matches!(torque, Force::Torque(_));
        turning(&mut group, &mut requests, (*torque, *value, known), (at, radius), notation);
    }
    let names = place(&group, &requests, None);
    group.group(names);
    group
}

/// The inertia torque of a link, where a free body shows it.
fn couple_of(sheet: &ForceSheet, link: LinkId) -> Option<f64> {
    let torques = sheet.bodies.iter().filter(|body| body.link == link).flat_map(|body| &body.torques);
    torques.filter(|(torque, _)| *torque == Force::InertiaTorque(link)).map(|(_, value)| *value).next()
}

/// A torque as an arc about a place, with its name: N m, and whether it is given.
fn turning(
    group: &mut Group,
    requests: &mut Vec<Request>,
    (torque, value, known): (Force, f64, bool),
    (at, radius): (Point, f64),
    notation: &Notation<'_>,
) {
    let mut own = Group::new(if known { "torque applied" } else { "torque sought" })
        .data("quantity", torque.name(notation.mechanism()))
        .data("value", format!("{}", value / notation.scene.units.torque.si));
    let sweep = if value < 0.0 { -2.2 } else { 2.2 };
    let start = if value < 0.0 { 2.6 } else { 0.5 };
    arc_arrow(&mut own, at, radius, start, sweep, THIN);
    group.group(own);
    let text = notation.symbol(Quantity::Force(torque, Share::Total), false);
    let mut request = Request::new(
        text,
        SMALL,
        Site::Around { at, radius: radius + 0.6, toward: Some(1.6) },
        "label torque-name",
    );
    request.leader = true;
    requests.push(request);
}

fn named(requests: &mut Vec<Request>, acting: &Acting, at: Point, along: Vec2, notation: &Notation<'_>) {
    let toward = Some(libm::atan2(-along.y, along.x));
    let text = symbol(acting.action, notation);
    let mut request = Request::new(text, SMALL, Site::Around { at, radius: 0.8, toward }, "label force-name");
    request.leader = true;
    requests.push(request);
}

/// A wavy stroke for a force of which nothing is known but where it acts.
fn wave(from: Point, along: Vec2) -> Vec<Point> {
    const PIECES: u32 = 36;
    const WAVES: f64 = 4.0;
    let side = Vec2::new(-along.y, along.x);
    (0..=PIECES)
        .map(|i| {
            let part = f64::from(i) / f64::from(PIECES);
            let swing = 0.8 * libm::sin(part * WAVES * std::f64::consts::TAU);
            from + along * (part * LINE) + side * swing
        })
        .collect()
}

/// A link by its points: a stroke from joint to joint, a block as a box.
fn draw_link(group: &mut Group, link: LinkId, places: &[(Point, Rich, bool)], notation: &Notation<'_>) {
    let mut own = Group::new("link").data("link", notation.number(link));
    let points: Vec<Point> = places.iter().map(|(at, ..)| *at).collect();
    match points[..] {
        [] => {}
        [only] => {
            let half = 3.0;
            let corners = [(-1.0, -0.7), (1.0, -0.7), (1.0, 0.7), (-1.0, 0.7)];
            let corners = corners.map(|(x, y)| only + Vec2::new(x * half, y * half)).to_vec();
            own.mark(Mark::outlined(Shape::Polygon(corners), Pen::solid(THIN), Tone::Paper));
        }
        [from, to] => own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(THICK)).precise()),
        _ => {
            let corners = super::ink::hull(&points);
            own.mark(Mark::area(Shape::Polygon(corners.clone()), Tone::Tint));
            let ring = corners.iter().copied().chain(corners.first().copied()).collect();
            own.mark(Mark::stroke(Shape::Polyline(ring), Pen::solid(THICK)).precise());
        }
    }
    for (at, _, joint) in places {
        if *joint {
            let circle = Shape::Circle { centre: *at, radius: 1.0 };
            own.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).precise());
        } else {
            own.mark(dot(*at, 0.6).precise());
        }
    }
    group.group(own);
}

/// Forces head to tail from the pole: thick what was known, thin what was found; with their sum where one is sought.
fn polygon(
    acting: &[Acting],
    sum: Option<Quantity>,
    pole: &Rich,
    sheet: &ForceSheet,
    notation: &Notation<'_>,
) -> Group {
    let per_mm = per_mm(sheet);
    let unit = &notation.scene.units.force;
    let mut group = Group::new("force polygon")
        .data("scale", format!("{}", per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol))
        .data("si-per-mm", format!("{per_mm}"));
    let mut requests = Vec::new();
    let Some(places) = chain(acting) else { return group };
    let place_of = |newtons: [f64; 2]| page(newtons.map(|n| n / per_mm));
    for (acting, ends) in acting.iter().zip(places.windows(2)) {
        let (from, to) = (place_of(ends[0]), place_of(ends[1]));
        let known = acting.known == Knowledge::Full;
        let size = libm::hypot(acting.force[0], acting.force[1]);
        let mut own = Group::new(if known { "vector force known" } else { "vector force found" })
            .data("quantity", acting.action.name(notation.mechanism()))
            .data("value", format!("{}", size / unit.si));
        let text = symbol(acting.action, notation);
        if from.distance(to) < SHORTEST {
            own = own.data("as-point", "true");
            own.mark(dot(to, 0.55).precise());
        } else {
            arrow(&mut own, from, to, if known { THICK } else { THIN });
        }
        group.group(own);
        if from.distance(to) >= SHORTEST_NAMED {
            let mut request = Request::new(text, SMALL, Site::Along { from, to }, "label vector-name");
            request.leader = true;
            requests.push(request);
        }
    }
    if let (Some(quantity), Some(last)) = (sum, places.last()) {
        let (from, to) = (Point::ORIGIN, place_of(*last));
        let size = libm::hypot(last[0], last[1]);
        let mut own = Group::new("vector force sum")
            .data("quantity", quantity.name(notation.mechanism()))
            .data("value", format!("{}", size / unit.si));
        arrow(&mut own, from, to, THICK);
        group.group(own);
        if from.distance(to) >= SHORTEST_NAMED {
            let text = notation.symbol(quantity, false);
            requests.push(Request::new(text, SMALL, Site::Along { from, to }, "label vector-name"));
        }
    }
    let mut own = Group::new("pole");
    let circle = Shape::Circle { centre: Point::ORIGIN, radius: 0.75 };
    own.mark(Mark::outlined(circle, Pen::solid(THIN), Tone::Paper).precise());
    group.group(own);
    let site = Site::Around { at: Point::ORIGIN, radius: 0.9, toward: None };
    requests.push(Request::new(pole.clone(), LABEL, site, "label image-name"));
    let names = place(&group, &requests, None);
    group.group(names);
    group
}

/// What is told of a body: that it is in balance, and the effort that follows.
#[must_use]
pub fn items(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Vec<Item> {
    let Some(body) = sheet.bodies.get(index) else { return Vec::new() };
    let words = notation.words;
    let terms: Vec<Rich> = body
        .acting
        .iter()
        .map(|acting| notation.symbol(Quantity::Force(Force::Vector(acting.action), Share::Total), true))
        .collect();
    let equation = Rich::join(&terms, &Rich::upright(" + ")).up(" = 0");
    let parts = [("link", Rich::upright(notation.number(body.link))), ("equation", equation)];
    let mut items = vec![Item::Sentence(Rich::fill(words.link_in_balance, &parts))];
    let unit = &notation.scene.units.force;
    let values = body.acting.iter().filter(|acting| acting.known != Knowledge::Full).map(|acting| {
        let size = libm::hypot(acting.force[0], acting.force[1]);
        symbol(acting.action, notation).up("\u{a0}=\u{a0}").then(&human::quantity(size, unit))
    });
    let torques = body.torques.iter().map(|(torque, value)| {
        let symbol = notation.symbol(Quantity::Force(*torque, Share::Total), false);
        symbol.up("\u{a0}=\u{a0}").then(&human::quantity(*value, &notation.scene.units.torque))
    });
    let found: Vec<Rich> = values.chain(torques).collect();
    if !found.is_empty() {
        items.push(Item::Sentence(Rich::join(&found, &Rich::upright(words.comma)).up(".")));
    }
    if let Some(axis) = sheet.friction_axis(body) {
        let template = match axis {
            FrictionAxis::Outer => words.friction_axis_outer,
            FrictionAxis::Inner => words.friction_axis_inner,
        };
        let link = [("link", Rich::upright(notation.number(body.link)))];
        items.push(Item::Sentence(Rich::fill(template, &link)));
    }
    items
}

/// What is told of a pair that rubs.
#[must_use]
pub fn friction_items(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Vec<Item> {
    friction::items(index, sheet, notation)
}
