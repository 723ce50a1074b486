//! Free bodies and force polygons as ink: every link cut free with what acts on it, and beside it the polygon of its
//! forces, laid off from the pole.

use std::borrow::Cow;

use kurbo::{Point, Rect, Vec2};

use super::figure::{Dash, Group, Mark, Node, Pen, Shape, Tone};
use super::force_detail::{self, Side};
use super::friction;
use super::governor;
use super::human;
use super::ink::{FINE, LABEL, SMALL, THICK, THIN, arc_arrow, arrow, dot, hatch_below, page};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::pose::{GuideLine, Pose};
use super::printed::either;
use super::rich::Rich;
use super::scale;
use super::skeleton::{self, Arrows, Overlay};
use super::statics::arm_name;
use crate::graphical::construction::{
    About, Acting, Arm, Construction, ForceSheet, FreeBody, Knowledge, MeetOfThree, MomentBalance, Parts,
    Turning,
};
use crate::mechanism::force::{Action, Force, Load, LoadKind, Party, Pointing, Share, Size, SpringKind};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, Rider, Roll};

/// Room for a polygon on upright A4, mm: the first in which no side is too short for its name. On other paper it grows as
/// the diagrams of the motion do.
const POLYGON: [f64; 3] = [85.0, 110.0, 140.0];
/// A scale that is coarser by no more than this takes in a polygon that could have a finer one.
const HARDLY: f64 = 1.3;
/// Lengths of arrows of free bodies, mm: they tell where and whither, the polygon how much.
const ARROWS: (f64, f64) = (9.0, 20.0);
/// A force shorter than this on its polygon is a point, mm, of which the steps tell.
const SHORTEST: f64 = 1.0;
/// Sides shorter than this crowd their names, mm.
const CROWDED: f64 = 3.0;
/// A side that is shorter than this part of the largest is never long enough.
const HOPELESS: f64 = 50.0;
/// Arrows whose lines are nearer than this, mm, and directions nearer than this cosine, lie on each other.
const ON_EACH_OTHER: (f64, f64) = (1.0, 0.995);
/// An arrow that stands so far from all other points has its name for itself, mm; looked for in so many steps of half of it.
const APART: f64 = 10.0;
const APART_STEPS: u32 = 12;
/// The line of a force that passes all points of a body at more than this stands alone, mm.
const ALONE: f64 = 25.0;
/// A line that passes a point nearer than this passes through it, mm.
const OFF_LINE: f64 = 0.1;
/// How far the lines of what a polygon finds run past their meeting.
const PAST: f64 = 7.0;
/// Arcs about places that are nearer to each other than this, mm, are drawn about each other.
const ABOUT_ONE: f64 = 12.0;
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
    /// Several links as if they were one, with the arms of their moments, by the place of these among all moments.
    Together(usize),
    /// The polygon of a free body.
    Polygon(usize),
    /// The polygon of two links that are cut free together; of no sheet, unless it is asked for.
    PolygonOf([LinkId; 2]),
    /// Everything from outside.
    Whole,
    /// The inertia forces and their sum.
    Shaking,
    /// A pair that rubs, enlarged, by its place among those that do.
    Friction(usize),
    /// The line of their sum on the skeleton.
    ShakingLine,
    /// What moving links exert on the frame, and the sum.
    Frame,
    /// The line of that sum on the skeleton.
    FrameLine,
    /// The arms that are asked and that no balance has.
    Arms,
}

/// Whether the polygon of all outer forces has the same sides as that of a body, which is then the only one that moves.
pub(super) fn whole_repeats(sheet: &ForceSheet) -> bool {
    let is_in = |all: &[Acting], own: &Acting| all.iter().any(|other| other.action == own.action);
    let same = |own: &[Acting]| {
        own.len() == sheet.whole.len() && own.iter().all(|acting| is_in(&sheet.whole, acting))
    };
    sheet.bodies.iter().any(|body| same(&body.acting))
}

impl ForcePanel {
    /// What a sheet of forces has, in order.
    #[must_use]
    pub fn all(sheet: &ForceSheet) -> Vec<Self> {
        let mut all = Vec::new();
        if !given(sheet).is_empty() {
            all.push(Self::Loads);
        }
        let mut waiting = Vec::new();
        for (index, body) in sheet.bodies.iter().enumerate() {
            all.extend(friction::before(index, sheet).map(Self::Friction));
            let together = sheet
                .moments
                .iter()
                .enumerate()
                .filter(|(_, m)| m.told == index && m.links.len() > 1 && !body.is_of(&m.links));
            all.push(Self::Body(index));
            all.extend(together.map(|(moments, _)| Self::Together(moments)));
            // Two forces are one line there and back.
            let laid_off = body.acting.len() > 2 && !governor::without_polygon(sheet, index);
            if laid_off && chain(&body.acting).is_some() {
                waiting.push(Self::Polygon(index));
            }
            if !body.with_next {
                all.append(&mut waiting);
            }
        }
        all.append(&mut waiting);
        // Two forces are one line there and back.
        if sheet.whole.len() > 2 && chain(&sheet.whole).is_some() {
            all.push(Self::Whole);
        }
        if chain(&sheet.inertia).is_some() {
            // One force is its own sum.
            if sheet.inertia.len() > 1 {
                all.push(Self::Shaking);
            }
            if sheet.shaking.is_some() {
                all.push(Self::ShakingLine);
            }
        }
        if chain(&sheet.frame).is_some() {
            if sheet.frame.len() > 1 {
                all.push(Self::Frame);
            }
            if sheet.frame_line.is_some() {
                all.push(Self::FrameLine);
            }
        }
        if sheet.arms.iter().any(|own| own.told == 0) {
            all.push(Self::Arms);
        }
        all
    }

    /// Whether a sheet has it without being told to: the shaking force only where somebody asks for it, and the polygon of all
    /// outer forces only where it is not that of a body once more.
    #[must_use]
    pub fn is_told(self, sheet: &ForceSheet) -> bool {
        match self {
            Self::Shaking | Self::ShakingLine => sheet.asks_shaking,
            Self::Whole => !whole_repeats(sheet),
            _ => true,
        }
    }

    /// The name of the figure in which it stands.
    #[must_use]
    pub fn belongs_to(self, name: &str, sheet: &ForceSheet, notation: &Notation<'_>) -> bool {
        let link = |index: usize| match sheet.bodies.get(index)?.of {
            Party::Link(link) => Some(notation.number(link)),
            Party::Pin(pin) => Some(notation.point_name(pin).to_owned()),
        };
        match (self, name) {
            (_, "forces") => self.is_told(sheet),
            (Self::Loads, "loads") | (Self::Shaking | Self::ShakingLine, "shaking") => true,
            (Self::Body(_) | Self::Together(_), "bodies")
            | (Self::Polygon(_), "polygons")
            | (Self::Whole, "polygon(all)")
            | (Self::Frame | Self::FrameLine, "polygon(frame)") => true,
            (Self::Friction(index), name) => {
                let point = friction::point(index, sheet, notation.mechanism());
                name == "friction" || point.is_some_and(|point| name == format!("friction({point})"))
            }
            (Self::Body(index), name) => link(index).is_some_and(|link| name == format!("body({link})")),
            (Self::Together(index), name) => sheet.moments.get(index).is_some_and(|moments| {
                let numbers: Vec<String> = moments.links.iter().map(|link| notation.number(*link)).collect();
                let named = figure_links(name, "body");
                named.len() == numbers.len() && numbers.iter().all(|number| named.contains(&number.as_str()))
            }),
            (Self::Polygon(index), name) => {
                link(index).is_some_and(|link| name == format!("polygon({link})"))
            }
            _ => false,
        }
    }

    /// The polygon that is asked for by two links; none where a figure names no two links with free bodies of their own.
    #[must_use]
    pub fn of_two(name: &str, sheet: &ForceSheet, notation: &Notation<'_>) -> Option<Self> {
        let [one, other] = figure_links(name, "polygon")[..] else { return None };
        let drawn = |number: &str| {
            let mut links = sheet.bodies.iter().flat_map(FreeBody::links);
            links.find(|link| notation.number(*link) == number)
        };
        Some(Self::PolygonOf([drawn(one)?, drawn(other)?]))
    }

    /// Its title.
    #[must_use]
    pub fn title(self, sheet: &ForceSheet, notation: &Notation<'_>) -> Rich {
        let words = notation.words;
        let of = |index: usize, of_link: &str, of_pin: &str| match sheet.bodies.get(index).map(|body| body.of)
        {
            Some(Party::Link(link)) => Rich::fill(of_link, &[("link", Rich::upright(notation.number(link)))]),
            Some(Party::Pin(pin)) => Rich::fill(of_pin, &[("point", notation.point(pin))]),
            None => Rich::default(),
        };
        match self {
            Self::Loads if sheet.inertia.is_empty() && inertia_free(sheet) => {
                Rich::upright(words.loads_only_figure)
            }
            Self::Loads => Rich::upright(words.loads_figure),
            Self::Body(index) => of(index, words.free_body_figure, words.free_pin_figure),
            Self::Polygon(index) => of(index, words.force_polygon_figure, words.pin_polygon_figure),
            Self::Together(index) => {
                let links = sheet.moments.get(index).map(|moments| notation.links(&moments.links));
                Rich::fill(words.free_bodies_figure, &[("links", links.unwrap_or_default())])
            }
            Self::PolygonOf(links) => {
                Rich::fill(words.links_polygon_figure, &[("links", notation.links(&links))])
            }
            Self::Whole => Rich::upright(words.outer_forces_figure),
            Self::Shaking => Rich::upright(words.shaking_figure),
            Self::Friction(index) => friction::title(index, sheet, notation),
            Self::ShakingLine => Rich::upright(words.shaking_line_figure),
            Self::Frame => Rich::upright(words.frame_figure),
            Self::FrameLine => Rich::upright(words.frame_line_figure),
            Self::Arms => Rich::upright(words.arms_figure),
        }
    }

    /// Its scale: newtons for the polygons, the skeleton's for what stands on it.
    #[must_use]
    pub fn scale(self, sheet: &ForceSheet, notation: &Notation<'_>) -> Option<Rich> {
        match self {
            Self::Friction(index) => friction::scale(index, sheet, notation),
            Self::Polygon(_) | Self::PolygonOf(_) | Self::Whole | Self::Shaking | Self::Frame => {
                let unit = &notation.scene.units.force;
                let per_cm = per_mm(sheet, self, notation)? * 10.0 / unit.si;
                let value = human::with_unit(&human::stated(per_cm), &unit.symbol);
                Some(value.up("\u{a0}≡\u{a0}1\u{a0}cm"))
            }
            Self::Loads
            | Self::Body(_)
            | Self::Together(_)
            | Self::ShakingLine
            | Self::FrameLine
            | Self::Arms => None,
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
            Self::Body(index) => {
                let body = sheet.bodies.get(index)?;
                let alone = |m: &&MomentBalance| !m.links.is_empty() && body.is_of(&m.links);
                let moments: Vec<&MomentBalance> = sheet.moments.iter().filter(alone).collect();
                let of: Vec<Party> =
                    std::iter::once(body.of).chain(body.with.iter().map(|link| Party::Link(*link))).collect();
                let free = Free { of: &of, acting: &body.acting, torques: &body.torques, moments: &moments };
                Some(free.draw(sheet, construction, notation))
            }
            Self::Together(index) => {
                let moments = sheet.moments.get(index)?;
                let parties: Vec<Party> = moments.links.iter().map(|link| Party::Link(*link)).collect();
                let bodies = bodies_of(&moments.links, sheet);
                let acting = from_without(&moments.links, sheet, notation);
                let torques: Vec<(Force, f64)> =
                    bodies.iter().flat_map(|body| &body.torques).copied().collect();
                let free = Free { of: &parties, acting: &acting, torques: &torques, moments: &[moments] };
                Some(free.draw(sheet, construction, notation))
            }
            Self::Polygon(index) => {
                let body = sheet.bodies.get(index)?;
                Some(polygon(&body.acting, None, &pole(body, notation), (self, sheet), notation))
            }
            Self::PolygonOf(links) => {
                let pole = pole_of(&links, notation);
                Some(polygon(&sides(sheet, self, notation), None, &pole, (self, sheet), notation))
            }
            Self::Whole => {
                Some(polygon(&sheet.whole, None, &Rich::italic("o").sub("f"), (self, sheet), notation))
            }
            Self::Shaking => {
                let sum = Quantity::Force(Force::Vector(Action::Shaking), Share::Total);
                let pole = Rich::italic("o").sub("f");
                Some(polygon(&sheet.inertia, Some(sum), &pole, (self, sheet), notation))
            }
            Self::ShakingLine => {
                let line = sheet.shaking.as_ref()?;
                sum_line((Action::Shaking, &sheet.inertia, line), sheet, construction, notation)
            }
            Self::Frame => {
                let sum = Quantity::Force(Force::Vector(Action::OnFrame), Share::Total);
                let pole = Rich::italic("o").sub("f");
                Some(polygon(&sheet.frame, Some(sum), &pole, (self, sheet), notation))
            }
            Self::FrameLine => {
                let line = sheet.frame_line.as_ref()?;
                sum_line((Action::OnFrame, &sheet.frame, line), sheet, construction, notation)
            }
            Self::Arms => Some(asked_arms(sheet, construction, notation)),
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

/// A force as a polygon shows it, or a part of one.
struct Stroke {
    /// Its ends from the pole, newtons.
    ends: [[f64; 2]; 2],
    symbol: Rich,
    quantity: String,
    of: Laid,
    /// Whether it is a force that is laid off in parts, or one of these.
    in_parts: bool,
}

/// What a stroke of a polygon is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Laid {
    /// It was known, and is laid off.
    Known,
    /// The polygon finds it.
    Found,
    /// What its parts, which are laid off, come to.
    Sum,
}

impl Stroke {
    fn length(&self) -> f64 {
        let [[ax, ay], [bx, by]] = self.ends;
        libm::hypot(bx - ax, by - ay)
    }
}

/// The parts in which a polygon lays off a force: that in which the force comes first.
pub(super) fn laid_off_in_parts(sheet: &ForceSheet, panel: ForcePanel, acting: &Acting) -> Option<Parts> {
    let ForcePanel::Polygon(index) = panel else { return None };
    let parts = acting.parts?;
    // Two forces are one line there and back.
    let has = |body: &FreeBody| {
        let same = |other: &Acting| either(other.action) == either(acting.action);
        body.acting.len() > 2 && body.acting.iter().any(same)
    };
    let of_force = || (0..sheet.bodies.len()).filter(|index| has(&sheet.bodies[*index]));
    let first = of_force().find(|index| sheet.bodies[*index].gives).or(of_force().next());
    (first == Some(index)).then_some(parts)
}

/// The forces of a polygon head to tail, in their parts where moments gave these; of what is open the lines follow each
/// other, so that they meet.
fn strokes(
    acting: &[Acting],
    (panel, sheet): (ForcePanel, &ForceSheet),
    notation: &Notation<'_>,
) -> Vec<Stroke> {
    let mechanism = notation.mechanism();
    let plus = |a: [f64; 2], b: [f64; 2]| [a[0] + b[0], a[1] + b[1]];
    let mut all = Vec::new();
    let mut at = [0.0; 2];
    let mut open = false;
    for own in acting {
        let ends = [at, plus(at, own.force)];
        at = ends[1];
        let whole = |of: Laid, in_parts: bool| Stroke {
            ends,
            symbol: symbol(own.action, notation),
            quantity: own.action.name(mechanism),
            of,
            in_parts,
        };
        let of = if own.closes { Laid::Found } else { Laid::Known };
        let Some(parts) = laid_off_in_parts(sheet, panel, own) else {
            all.push(whole(of, false));
            open |= own.closes;
            continue;
        };
        let mark = |mark: &str| super::force_names::part(notation, own.action, mark);
        let across = (parts.across, mark(notation.profile.tangential), part_name("Ft", own, parts, notation));
        let along = (parts.along, mark(notation.profile.normal), part_name("Fn", own, parts, notation));
        // What the polygon finds of the second force begins where that of the first one ends.
        let (first, second) =
            if open { ((along, of), (across, Laid::Known)) } else { ((across, Laid::Known), (along, of)) };
        let mut from = ends[0];
        for ((force, symbol, quantity), of) in [first, second] {
            let to = plus(from, force);
            all.push(Stroke { ends: [from, to], symbol, quantity, of, in_parts: true });
            from = to;
        }
        all.push(whole(Laid::Sum, true));
        open |= own.closes;
    }
    all
}

/// The name of a part of a force at a pin: Ft(3,4/O4).
fn part_name(letters: &str, acting: &Acting, parts: Parts, notation: &Notation<'_>) -> String {
    let name = acting.action.name(notation.mechanism());
    let inside = name.trim_start_matches('F').trim_matches(|c| c == '(' || c == ')');
    format!("{letters}({inside}/{})", notation.point_name(parts.line[0]))
}

/// How much room a polygon takes: of one that is low and has a row to itself its width takes less.
fn extent(places: &[[f64; 2]]) -> f64 {
    /// A row is so much wider than a polygon beside others may be.
    const LOW: f64 = 0.85;
    let [width, height] = [0, 1].map(|axis| {
        let all = || places.iter().map(|p| p[axis]);
        all().fold(f64::MIN, f64::max) - all().fold(f64::MAX, f64::min)
    });
    height.max(if 2.0 * height < width { LOW * width } else { width })
}

/// The pole of the polygon of a body.
#[must_use]
pub fn pole(body: &FreeBody, notation: &Notation<'_>) -> Rich {
    match body.of {
        Party::Link(_) => pole_of(&body.links(), notation),
        Party::Pin(pin) => Rich::italic("o").sub(&format!("{}f", notation.index(pin))),
    }
}

/// The pole of the polygon of links.
fn pole_of(links: &[LinkId], notation: &Notation<'_>) -> Rich {
    let numbers: Vec<String> = links.iter().map(|link| notation.number(*link)).collect();
    Rich::italic("o").sub(&format!("{}f", numbers.join(",")))
}

/// The links that a figure names: 3 and 4 of `polygon(3,4)`; none where it is another figure.
fn figure_links<'a>(name: &'a str, head: &str) -> Vec<&'a str> {
    let inside = name.strip_prefix(head).and_then(|rest| rest.strip_prefix('(')?.strip_suffix(')'));
    inside.map(|inside| inside.split(',').map(str::trim).collect()).unwrap_or_default()
}

/// The free bodies of links that are cut free together, once each: not on their own those that stand with the others.
fn bodies_of<'a>(links: &[LinkId], sheet: &'a ForceSheet) -> Vec<&'a FreeBody> {
    let joined = |body: &FreeBody| {
        body.with.is_empty()
            && sheet.bodies.iter().any(|other| body.links().iter().any(|l| other.with.contains(l)))
    };
    let of = |body: &&FreeBody| matches!(body.of, Party::Link(link) if links.contains(&link));
    sheet.bodies.iter().filter(|body| of(body) && !joined(body)).collect()
}

/// What acts on links that are cut free together from without: known forces first.
fn from_without(links: &[LinkId], sheet: &ForceSheet, notation: &Notation<'_>) -> Vec<Acting> {
    let inner = |acting: &Acting| {
        let (pins, others) = acting.action.about();
        match acting.action {
            Action::Pair { .. } => others.iter().flatten().all(|link| links.contains(link)),
            Action::OfPin(..) => pins.iter().flatten().all(|pin| {
                let parties = notation.mechanism().parties_at(*pin);
                parties.iter().all(|link| links.contains(link))
            }),
            Action::Drive(input) | Action::DriveBack(input) => {
                let between = notation.mechanism().driven_between(input);
                between.iter().all(|link| links.contains(link))
            }
            _ => false,
        }
    };
    let bodies = bodies_of(links, sheet);
    bodies.iter().flat_map(|body| &body.acting).filter(|acting| !inner(acting)).copied().collect()
}

/// Whether nothing on a sheet comes from inertia.
fn inertia_free(sheet: &ForceSheet) -> bool {
    let is_inertia = |acting: &Acting| matches!(acting.action, Action::Inertia(_));
    sheet.bodies.iter().all(|body| {
        !body.acting.iter().any(is_inertia)
            && !body.torques.iter().any(|(torque, _)| matches!(torque, Force::InertiaTorque(_)))
    })
}

/// The forces of a polygon.
fn sides<'a>(sheet: &'a ForceSheet, panel: ForcePanel, notation: &Notation<'_>) -> Cow<'a, [Acting]> {
    match panel {
        ForcePanel::Polygon(index) => {
            Cow::Borrowed(sheet.bodies.get(index).map_or(&[], |body| &body.acting[..]))
        }
        ForcePanel::PolygonOf(links) => {
            let mut all = from_without(&links, sheet, notation);
            all.sort_by_key(|acting| acting.closes);
            Cow::Owned(all)
        }
        ForcePanel::Whole => Cow::Borrowed(&sheet.whole),
        ForcePanel::Shaking => Cow::Borrowed(&sheet.inertia),
        ForcePanel::Frame => Cow::Borrowed(&sheet.frame),
        _ => Cow::Borrowed(&[]),
    }
}

/// Newtons per millimetre of a polygon, round in the scene's unit: the scale at which it fills its place, or that of another
/// polygon of the sheet that is hardly coarser.
#[must_use]
pub fn per_mm(sheet: &ForceSheet, panel: ForcePanel, notation: &Notation<'_>) -> Option<f64> {
    let own = filling(sheet, panel, notation)?;
    if let Some(stated) = notation.scene.sheet.force_scale {
        return Some(stated);
    }
    let drawn = |panel: &ForcePanel| {
        let is_line = matches!(panel, ForcePanel::Polygon(_)) && sides(sheet, *panel, notation).len() <= 2;
        !is_line && panel.is_told(sheet)
    };
    let of_sums = [ForcePanel::Whole, ForcePanel::Shaking, ForcePanel::Frame];
    let all = (0..sheet.bodies.len()).map(ForcePanel::Polygon).chain(of_sums);
    let near = all.filter(drawn).filter_map(|other| filling(sheet, other, notation));
    Some(near.filter(|scale| *scale <= own * HARDLY).fold(own, f64::max))
}

/// The scale at which a polygon fills its place with no more sides than there have to be too short for their names.
fn filling(sheet: &ForceSheet, panel: ForcePanel, notation: &Notation<'_>) -> Option<f64> {
    let forces = sides(sheet, panel, notation);
    chain(&forces)?;
    let strokes = strokes(&forces, (panel, sheet), notation);
    let places: Vec<[f64; 2]> = strokes.iter().flat_map(|stroke| stroke.ends).collect();
    let size = extent(&places);
    if size <= 0.0 {
        return None;
    }
    let lengths: Vec<f64> =
        strokes.iter().map(Stroke::length).filter(|length| *length > size / HOPELESS).collect();
    let unit = notation.scene.units.force.si;
    let crowded = |scale: f64| lengths.iter().filter(|length| **length / scale < CROWDED).count();
    let (wider, higher) = scale::stretch(notation.scene);
    let scales = POLYGON.iter().map(|room| round_scale(size, room * wider.min(higher), unit));
    scales.reduce(|best, next| if crowded(next) < crowded(best) { next } else { best })
}

/// Newtons per millimetre of the larger polygons of a sheet, where there are any.
#[must_use]
pub fn of_polygons(sheet: &ForceSheet, notation: &Notation<'_>) -> Option<f64> {
    let bodies = (0..sheet.bodies.len()).map(ForcePanel::Polygon);
    let all = bodies.chain([ForcePanel::Whole, ForcePanel::Shaking, ForcePanel::Frame]);
    all.filter(|panel| panel.is_told(sheet))
        .filter_map(|panel| per_mm(sheet, panel, notation))
        .reduce(f64::max)
}

/// The finest round scale at which so much has room.
fn round_scale(largest: f64, room: f64, unit: f64) -> f64 {
    let least = largest / room * 10.0 / unit;
    let power = libm::pow(10.0, libm::floor(libm::log10(least)));
    let round = STEPS.iter().map(|step| step * power).chain([10.0 * power]).find(|scale| *scale >= least);
    round.filter(|scale| scale.is_normal()).unwrap_or(10.0) * unit / 10.0
}

/// What is given and what follows from the motion.
fn given(sheet: &ForceSheet) -> Vec<Acting> {
    let mut all: Vec<Acting> = Vec::new();
    for acting in sheet.bodies.iter().flat_map(|body| &body.acting) {
        let is_given = matches!(
            acting.action,
            Action::Load(_)
                | Action::Weight(_)
                | Action::Inertia(_)
                | Action::Spring { .. }
                | Action::Drag(_)
                | Action::Centrifugal(_)
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
    super::force_names::acting(notation, action)
}

/// Whether another arrow goes on in line with one, next to its head: a name there would be read as that of the other.
fn goes_on((from, to): Stretch, all: &[Stretch]) -> bool {
    /// Room of a name beside a head, mm.
    const NAME: f64 = 6.0;
    let along = (to - from).normalize();
    let in_line =
        |(a, b): &Stretch| [a, b].iter().all(|end| (**end - from).cross(along).abs() < ON_EACH_OTHER.0);
    let next_to_head = |(a, b): &Stretch| {
        let [start, end] = [a, b].map(|end| (*end - to).dot(along));
        start.min(end) < NAME && start.max(end) > -NAME
    };
    let others = all.iter().filter(|(a, b)| a.distance(from) > 1e-6 || b.distance(to) > 1e-6);
    others.filter(|other| in_line(other)).any(next_to_head)
}

/// An arrow at a place, whose length only hints at the size; all arrows of the drawing tell where its name stands.
fn short_arrow(
    group: &mut Group,
    requests: &mut Vec<Request>,
    acting: &Acting,
    at: Point,
    (most, all): (f64, &[Stretch]),
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
    let beside = Site::Along { from: at, to };
    let at_head = Site::Around { at: to, radius: 1.0, toward: Some(libm::atan2(-along.y, along.x)) };
    let mut request = if goes_on((at, to), all) {
        Request::new(text, SMALL, beside, "label force-name")
    } else {
        Request::new(text, SMALL, at_head, "label force-name").or(beside)
    };
    request.leader = true;
    requests.push(request);
}

/// Metres from the skeleton's origin as a place of the page.
pub(super) fn on_page(metres: [f64; 2], construction: &Construction) -> Point {
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
        if let Some(governor) = &sheet.governor {
            governor::radius(&mut overlay.ink, &mut overlay.labels, governor, construction, notation);
        }
        let mut taken = Vec::new();
        let all_bars = bars_of_skeleton(construction, notation);
        for (link, torque, value) in given_torques(sheet) {
            let first = notation.mechanism().link(link).points.first();
            let at = first.and_then(|point| *construction.space.places.get(point.0)?);
            if let Some(at) = at.map(page) {
                let known = (torque, value, true);
                turning(&mut overlay.ink, &mut overlay.labels, known, (at, 6.5), notation);
            }
        }
        let arrows: Vec<Point> = all
            .iter()
            .map(|acting| {
                let through = on_page(acting.through, construction);
                off_the_link((&all_bars, &mut taken), acting, through, most)
            })
            .collect();
        for blank in taken.iter().filter_map(|arrow| blank_under(*arrow, &all_bars)) {
            overlay.ink.mark(blank);
        }
        for (acting, at_arrow) in all.iter().zip(arrows) {
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
            short_arrow(&mut overlay.ink, &mut overlay.labels, acting, at_arrow, (most, &taken), notation);
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

/// The torques that are given, with their links, and those of inertia that stand beside no force of inertia.
fn given_torques(sheet: &ForceSheet) -> Vec<(LinkId, Force, f64)> {
    let mut all: Vec<(LinkId, Force, f64)> = Vec::new();
    for body in &sheet.bodies {
        let Party::Link(link) = body.of else { continue };
        let alone = |of: LinkId| body.acting.iter().all(|acting| acting.action != Action::Inertia(of));
        for (torque, value) in &body.torques {
            let told = all.iter().any(|(_, other, _)| other == torque);
            let drawn = match torque {
                Force::LoadTorque(_) => true,
                Force::InertiaTorque(of) => alone(*of),
                _ => false,
            };
            if drawn && !told {
                all.push((link, *torque, *value));
            }
        }
    }
    all
}

/// A stretch of a straight line, from end to end.
type Stretch = (Point, Point);

/// Where an arrow begins that would else lie on another on its line: beyond the other's tip.
fn beyond(taken: &mut Vec<(Point, Point)>, acting: &Acting, at: Point, most: f64) -> Point {
    let size = libm::hypot(acting.force[0], acting.force[1]);
    if size <= 0.0 {
        return at;
    }
    let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
    let length = ARROWS.0 + (ARROWS.1 - ARROWS.0) * size / most;
    let mut from = at;
    for (tail, tip) in taken.iter() {
        let other = (*tip - *tail).normalize();
        let off = (from - *tail).cross(other).abs();
        if other.dot(along) > ON_EACH_OTHER.1 && off < ON_EACH_OTHER.0 {
            let reach = (from - *tail).dot(other);
            if reach > -length && reach < tail.distance(*tip) + 2.5 {
                from = *tip + along * 2.5;
            }
        }
    }
    taken.push((from, from + along * length));
    from
}

/// How a link of these points is drawn.
enum Outline {
    /// No stroke: it has one place, or none.
    Spot,
    /// One stroke, from end to end.
    Bar(Stretch),
    /// A plate by its corners.
    Plate(Vec<Point>),
}

impl Outline {
    fn of(points: &[Point]) -> Self {
        match *points {
            [] | [_] => Self::Spot,
            [from, to] => Self::Bar((from, to)),
            _ => match in_line(points) {
                Some([from, to]) => Self::Bar((from, to)),
                None => Self::Plate(super::ink::hull(points)),
            },
        }
    }
}

/// The strokes of a link of these points: from end to end, or round its plate.
fn bars(points: &[Point]) -> Vec<Stretch> {
    let mut all = match Outline::of(points) {
        Outline::Spot => Vec::new(),
        Outline::Bar(bar) => vec![bar],
        Outline::Plate(corners) => {
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| (*a, *b)).collect()
        }
    };
    all.retain(|(a, b)| a.distance(*b) > 1.0);
    all
}

/// The strokes of all links of the skeleton.
fn bars_of_skeleton(construction: &Construction, notation: &Notation<'_>) -> Vec<Stretch> {
    let pose = Pose::new(notation.mechanism(), &construction.space);
    let places = |link| pose.places(link).into_iter().map(|(_, at)| at).collect::<Vec<Point>>();
    notation.mechanism().moving().flat_map(|link| bars(&places(link))).collect()
}

/// The points by which a link is drawn: its own, and where something slides on it or rolls that stands apart from them.
fn drawn_by(own: &[(Point, Rich, bool)], riders: &[Point]) -> Vec<Point> {
    let mut points: Vec<Point> = own.iter().map(|(at, ..)| *at).collect();
    for rider in riders {
        if points.iter().all(|at| at.distance(*rider) > 1.0) {
            points.push(*rider);
        }
    }
    points
}

/// From each of these points to each other one: within them all is on the link.
fn spans(points: &[Point]) -> impl Iterator<Item = Stretch> {
    let pairs = points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| (*b, *a)));
    pairs.filter(|(a, b)| a.distance(*b) > 1.0)
}

/// Whether an arrow cannot be told from a stroke on which it lies.
fn lies_on((from, to): (Point, Point), (a, b): (Point, Point)) -> bool {
    /// Nearer to each other than this two strokes look like one, and so little of an arrow may lie on one, mm.
    const NEAR: f64 = 1.2;
    const SHORT: f64 = 2.0;
    let along = (b - a).normalize();
    let beside = [from, to].map(|p| (p - a).cross(along).abs());
    let [start, end] = [from, to].map(|p| (p - a).dot(along));
    let shared = start.max(end).min(a.distance(b)) - start.min(end).max(0.0);
    beside.iter().all(|off| *off < NEAR) && shared > SHORT
}

/// Where an arrow begins that would else lie on the link on which it acts, or on another arrow: with its head at its place and
/// its shaft outside of the link, or further along its line. One that acts in the middle of a stroke stays there: the stroke
/// gives way to it.
fn off_the_link(
    (bars, taken): (&[Stretch], &mut Vec<Stretch>),
    acting: &Acting,
    at: Point,
    most: f64,
) -> Point {
    /// Blank between a joint and the head of an arrow, and how far and by how much arrows are moved along their line, mm.
    const JOINT: f64 = 1.4;
    const STEP: f64 = 2.5;
    const STEPS: u32 = 60;
    let size = libm::hypot(acting.force[0], acting.force[1]);
    if size <= 0.0 {
        return at;
    }
    let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
    let length = ARROWS.0 + (ARROWS.1 - ARROWS.0) * size / most;
    let stroke = |from: Point| (from, from + along * length);
    let before = taken.len();
    let first = beyond(taken, acting, at, most);
    if !bars.iter().any(|bar| lies_on(stroke(first), *bar)) {
        return first;
    }
    taken.truncate(before);
    let free = |from: &Point| !bars.iter().chain(taken.iter()).any(|other| lies_on(stroke(*from), *other));
    // Past another joint it would seem to act there.
    let open = |way: Vec2| !bars.iter().any(|bar| lies_on((at, at + way * (2.0 * STEP)), *bar));
    let (behind, ahead) = (open(-along), open(along));
    let ways = (0..STEPS).flat_map(|step| {
        let off = JOINT + STEP * f64::from(step);
        let back = behind.then(|| at - along * (length + off));
        back.into_iter().chain(ahead.then(|| at + along * off))
    });
    let beside = |from: &Point| !taken.iter().any(|other| lies_on(stroke(*from), *other));
    let on_link = (0..STEPS).map(|step| at + along * (STEP * f64::from(step)));
    let from = ways.into_iter().find(free).or_else(|| on_link.into_iter().find(beside)).unwrap_or(first);
    taken.push(stroke(from));
    from
}

/// Blank in the stroke of a link beyond the ends of an arrow that stands on it, mm.
const BLANK: f64 = 1.0;

/// A stroke of a link without what arrows cover of it, and a little blank at the ends of each.
fn giving_way((from, to): Stretch, arrows: &[Stretch]) -> Vec<Stretch> {
    let length = from.distance(to);
    let along = (to - from).normalize();
    let mut gaps: Vec<[f64; 2]> = arrows
        .iter()
        .filter(|arrow| lies_on(**arrow, (from, to)))
        .map(|(tail, tip)| {
            let [start, end] = [*tail, *tip].map(|p| (p - from).dot(along));
            [start.min(end) - BLANK, start.max(end) + BLANK]
        })
        .collect();
    gaps.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let mut pieces = Vec::new();
    let mut done = 0.0;
    for [start, end] in gaps {
        if start > done {
            pieces.push((from + along * done, from + along * start.min(length)));
        }
        done = end.max(done);
    }
    if done < length {
        pieces.push((from + along * done, to));
    }
    pieces
}

/// The strokes of links give way to arrows that stand on them.
fn give_way(group: &mut Group, arrows: &[Stretch]) {
    let is_link = |group: &Group| group.class == "link";
    let links = group.children.iter_mut().filter_map(|node| match node {
        Node::Group(own) if is_link(own) => Some(own),
        _ => None,
    });
    for link in links {
        let mut cut = Vec::new();
        for node in std::mem::take(&mut link.children) {
            let strokes = match &node {
                Node::Mark(Mark { shape: shape @ (Shape::Line(..) | Shape::Polyline(_)), .. }) => {
                    shape.outline()
                }
                _ => Vec::new(),
            };
            let covered = |stroke: &Stretch| arrows.iter().any(|arrow| lies_on(*arrow, *stroke));
            match node {
                Node::Mark(mark) if strokes.iter().any(covered) => {
                    let pieces = strokes.into_iter().flat_map(|stroke| giving_way(stroke, arrows));
                    cut.extend(
                        pieces.map(|(from, to)| {
                            Node::Mark(Mark { shape: Shape::Line(from, to), ..mark.clone() })
                        }),
                    );
                }
                node => cut.push(node),
            }
        }
        link.children = cut;
    }
}

/// The blank in a stroke of the skeleton where an arrow stands on it. The joint at which that begins stays whole.
fn blank_under((from, to): Stretch, bars: &[Stretch]) -> Option<Mark> {
    /// Half its breadth, and the radius of a joint, mm.
    const HALF: f64 = 0.5;
    const JOINT: f64 = 1.3;
    let covered = bars.iter().any(|bar| lies_on((from, to), *bar));
    let along = (to - from).normalize();
    let (start, end) = (from + along * JOINT, to + along * BLANK);
    let corners = super::ink::turned_rect(start.midpoint(end), along, start.distance(end) / 2.0, HALF);
    covered.then(|| Mark::area(Shape::Polygon(corners), Tone::Paper))
}

/// What is drawn of a body, or of the skeleton, and the room around it in which forces stand to scale.
#[derive(Clone, Copy)]
struct Frame(Rect);

/// Where an arrow stands.
enum Stand {
    /// On its line.
    At(Point),
    /// At the border, beside which its line lies far off.
    Border(Point),
}

impl Frame {
    /// Room beside a body, mm.
    const BESIDE: f64 = 70.0;

    fn around(ink: Rect) -> Self {
        Self(ink.inflate(Self::BESIDE, Self::BESIDE))
    }

    fn of_skeleton(construction: &Construction) -> Option<Self> {
        let mut places = construction.space.places.iter().flatten().map(|place| page(*place));
        let first = places.next()?;
        Some(Self::around(places.fold(Rect::from_points(first, first), |all, at| all.union_pt(at))))
    }

    /// Where the arrow of a force begins: at its place, on its line beside the body, or at the border, square to its line from
    /// what is near.
    fn stand(self, acting: &Acting, at: Point, near: Option<Point>) -> Stand {
        let size = libm::hypot(acting.force[0], acting.force[1]);
        if self.0.contains(at) || size <= 0.0 {
            return Stand::At(at);
        }
        let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
        let square = |from: Point| at + along * (from - at).dot(along);
        let foot = square(self.0.center());
        if self.0.contains(foot) {
            return Stand::At(foot);
        }
        let from = near.unwrap_or(self.0.center());
        Stand::Border(self.cut(from, square(from)))
    }

    /// The same on a skeleton, with what leads there where that is far.
    fn arrow_at(
        self,
        overlay: &mut Overlay,
        acting: &Acting,
        near: Option<Point>,
        (construction, notation): (&Construction, &Notation<'_>),
    ) -> Point {
        let on_line = on_page(acting.through, construction);
        match self.stand(acting, on_line, near) {
            Stand::At(at) => at,
            Stand::Border(border) => {
                let force = (acting, on_line, border);
                far_off(&mut overlay.ink, &mut overlay.labels, force, near, (construction, notation));
                border
            }
        }
    }

    /// A line as far as the border.
    fn cut(self, from: Point, to: Point) -> Point {
        match super::overlap::clip(from, to, self.0) {
            Some((_, end)) => from.lerp(to, end),
            None => from,
        }
    }
}

/// Whether the line of a force is known.
fn tells_line(acting: &Acting) -> bool {
    matches!(acting.known, Knowledge::Full | Knowledge::Line)
}

/// The point of a force's line nearest to another one; none of a force of no size.
fn foot_on(acting: &Acting, on_line: Point, from: Point) -> Option<Point> {
    let size = libm::hypot(acting.force[0], acting.force[1]);
    let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
    (size > 0.0).then(|| on_line + along * (from - on_line).dot(along))
}

/// Whether an arm is beyond all proportion to what is drawn: a force that cannot be told from zero, with a couple.
pub(super) fn is_a_couple(arm: &Arm, construction: &Construction) -> bool {
    /// Of the room of a sheet.
    const BEYOND: f64 = 1e7;
    arm.length > BEYOND * Frame::BESIDE * construction.space.metres_per_mm
}

/// A line from what is drawn to a force that lies beyond the border, with how far off that is.
fn far_off(
    group: &mut Group,
    requests: &mut Vec<Request>,
    (acting, at, border): (&Acting, Point, Point),
    near: Option<Point>,
    (construction, notation): (&Construction, &Notation<'_>),
) {
    let size = libm::hypot(acting.force[0], acting.force[1]);
    let Some(near) = near.filter(|near| size > 0.0 && near.distance(border) > SHORTEST) else { return };
    let across = Vec2::new(acting.force[1] / size, acting.force[0] / size);
    let metres = (at - near).dot(across).abs() * construction.space.metres_per_mm;
    let mut own = Group::new("far-off").data("quantity", acting.action.name(notation.mechanism()));
    let line = Shape::Line(near, border);
    own.mark(Mark::stroke(line, Pen { width: FINE, dash: Dash::Dashed }).precise());
    own.mark(super::ink::head(border, (border - near).normalize(), 2.0));
    group.group(own);
    let unit = &notation.scene.units.length;
    let text = human::quantity(metres, unit);
    let mut request = Request::new(text, SMALL, Site::Along { from: near, to: border }, "label far-off");
    request.leader = true;
    requests.push(request);
}

/// Where on its line the arrow of a force begins so that its name is not taken for that of something else: as near to `at` as
/// it stands a finger's breadth from all other points, within what they span; else where it stands farthest from them.
fn apart(others: &[Point], acting: &Acting, at: Point, most: f64) -> Point {
    let size = libm::hypot(acting.force[0], acting.force[1]);
    if size <= 0.0 {
        return at;
    }
    let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
    let length = ARROWS.0 + (ARROWS.1 - ARROWS.0) * size / most;
    let distance = |from: Point, point: Point| {
        let reach = (point - from).dot(along).clamp(0.0, length);
        (from + along * reach).distance(point)
    };
    let free = |from: Point| others.iter().map(|point| distance(from, *point)).fold(APART, f64::min);
    let span = others.iter().fold(Rect::from_points(at, at), |span, point| span.union_pt(*point));
    let mut best = at;
    for step in 1..=APART_STEPS {
        for way in [1.0, -1.0] {
            let from = at + along * (way * APART / 2.0 * f64::from(step));
            let inside = span.contains(from) && span.contains(from + along * length);
            if inside && free(from) > free(best) + 1e-6 {
                best = from;
            }
        }
    }
    best
}

/// The sum of forces on the line that moments have found; none where they have found a couple.
fn sum_on_its_line(action: Action, forces: &[Acting], line: &MomentBalance) -> Option<Acting> {
    let arm = line.found.arm?;
    let force = forces.iter().fold([0.0; 2], |sum: [f64; 2], a| [sum[0] + a.force[0], sum[1] + a.force[1]]);
    Some(Acting {
        action,
        at: arm.foot,
        through: arm.foot,
        force,
        known: Knowledge::Full,
        closes: false,
        with_couple: false,
        parts: None,
        couple: 0.0,
    })
}

/// The line of a sum of forces on the skeleton, with its distance from the first fixed pivot.
fn sum_line(
    (action, forces, line): (Action, &[Acting], &MomentBalance),
    sheet: &ForceSheet,
    construction: &Construction,
    notation: &Notation<'_>,
) -> Option<Group> {
    let whole = sum_on_its_line(action, forces, line)?;
    let mut bare = construction.clone();
    bare.space.lines.clear();
    bare.others.clear();
    let most = largest(forces).max(libm::hypot(whole.force[0], whole.force[1]));
    Some(skeleton::draw_under(&bare, notation, Arrows::Inputs, None, |_, _| {
        let mut overlay = Overlay { ink: Group::new("forces"), ..Overlay::default() };
        let mut taken = Vec::new();
        let mut moments = line.clone();
        moments.terms.push(moments.found);
        let Some(frame) = Frame::of_skeleton(&bare) else { return overlay };
        let near = bare.space.places.iter().flatten().map(|place| page(*place)).next();
        let shown = (construction, notation);
        let mut arrows = Vec::new();
        for acting in forces {
            let at = frame.arrow_at(&mut overlay, acting, near, shown);
            arrows.push((acting, beyond(&mut taken, acting, at, most)));
        }
        for (acting, at) in arrows {
            short_arrow(&mut overlay.ink, &mut overlay.labels, acting, at, (most, &taken), notation);
        }
        for term in &line.terms {
            let Turning::Torque(torque @ Force::InertiaTorque(link)) = term.of else { continue };
            let centre = forces.iter().find(|acting| acting.action == Action::Inertia(link));
            let first = notation.mechanism().link(link).points.first();
            let first = first.and_then(|point| *construction.space.places.get(point.0)?).map(page);
            if let Some(at) = centre.map(|acting| on_page(acting.at, construction)).or(first) {
                let known = (torque, term.moment, true);
                turning(&mut overlay.ink, &mut overlay.labels, known, (at, 4.5), notation);
            }
        }
        // The sum stands on its line where nothing else stands.
        let foot = frame.arrow_at(&mut overlay, &whole, near, shown);
        let mut others: Vec<Point> = bare.space.places.iter().flatten().map(|p| page(*p)).collect();
        others.extend(taken.iter().flat_map(|(tail, tip)| [*tail, tail.midpoint(*tip), *tip]));
        let from = apart(&others, &whole, foot, most);
        if from != foot {
            let line = Shape::Line(foot, from);
            overlay.ink.mark(Mark::stroke(line, Pen { width: FINE, dash: Dash::Dashed }).precise());
        }
        short_arrow(&mut overlay.ink, &mut overlay.labels, &whole, from, (most, &taken), notation);
        let bars = bars_of_skeleton(construction, notation);
        let mut room = RoomOfArms { frame, bars: &bars, aside: Vec::new() };
        arms(&mut overlay.ink, &mut overlay.labels, &moments, &mut room, (sheet, construction, notation));
        overlay
    }))
}

/// The arms that are asked, with the forces to whose lines they lead, on the skeleton.
fn asked_arms(sheet: &ForceSheet, construction: &Construction, notation: &Notation<'_>) -> Group {
    let mut bare = construction.clone();
    bare.space.lines.clear();
    bare.others.clear();
    let own: Vec<&MomentBalance> = sheet.arms.iter().filter(|own| own.told == 0).collect();
    let mut acting: Vec<Acting> = Vec::new();
    for term in own.iter().flat_map(|own| &own.terms) {
        let Turning::Force(action) = term.of else { continue };
        let of_whole = || sheet.whole.iter().find(|acting| acting.action == action).copied();
        let drawn = drawn(sheet, action).or_else(of_whole);
        acting.extend(drawn.filter(|_| acting.iter().all(|other| other.action != action)));
    }
    let most = largest(&acting);
    skeleton::draw_under(&bare, notation, Arrows::Inputs, None, |_, _| {
        let mut overlay = Overlay { ink: Group::new("forces"), ..Overlay::default() };
        let mut taken = Vec::new();
        let Some(frame) = Frame::of_skeleton(&bare) else { return overlay };
        let near = bare.space.places.iter().flatten().map(|place| page(*place)).next();
        let mut arrows = Vec::new();
        for acting in &acting {
            let at = frame.arrow_at(&mut overlay, acting, near, (construction, notation));
            arrows.push((acting, beyond(&mut taken, acting, at, most)));
        }
        for (acting, at) in arrows {
            short_arrow(&mut overlay.ink, &mut overlay.labels, acting, at, (most, &taken), notation);
        }
        let bars = bars_of_skeleton(construction, notation);
        let mut room = RoomOfArms { frame, bars: &bars, aside: Vec::new() };
        for own in &own {
            arms(&mut overlay.ink, &mut overlay.labels, own, &mut room, (sheet, construction, notation));
        }
        overlay
    })
}

/// Where arms are dimensioned.
struct RoomOfArms<'a> {
    frame: Frame,
    /// The strokes of links, on which no dimension line is seen.
    bars: &'a [Stretch],
    /// The dimension lines that stand beside a stroke.
    aside: Vec<Stretch>,
}

impl RoomOfArms<'_> {
    /// Where the dimension line of an arm stands: at the arm, or beside the link along which that lies, on the side on which
    /// less stands, of two alike on that from which the force comes.
    fn stand(&mut self, arm: Stretch, force: Option<Vec2>) -> Stretch {
        /// The distance of a dimension line from the link, and of the next one from it, mm.
        const BESIDE: f64 = 4.0;
        const LINES: u32 = 5;
        /// What is nearer to the line of the arm than this is on it, mm.
        const ON: f64 = 1.5;
        if !self.bars.iter().any(|bar| lies_on(arm, *bar)) {
            return arm;
        }
        let along = (arm.1 - arm.0).normalize();
        let left = Vec2::new(along.y, -along.x);
        let ends = || self.bars.iter().flat_map(|(a, b)| [*a, *b]);
        let beyond = |side: Vec2| ends().filter(|end| (*end - arm.0).dot(side) > ON).count();
        let comes_from_left = force.is_some_and(|force| force.dot(left) < 0.0);
        let side = match beyond(left).cmp(&beyond(-left)) {
            std::cmp::Ordering::Less => left,
            std::cmp::Ordering::Greater => -left,
            std::cmp::Ordering::Equal if comes_from_left => left,
            std::cmp::Ordering::Equal => -left,
        };
        let at = |line: u32| {
            let by = side * (BESIDE * f64::from(line));
            (arm.0 + by, arm.1 + by)
        };
        let free = |stretch: &Stretch| !self.aside.iter().any(|other| lies_on(*stretch, *other));
        let found = (1..=LINES).map(at).find(free).unwrap_or(at(1));
        self.aside.push(found);
        found
    }
}

/// The arms of moments, from the point about which they are taken to the foot on each line.
fn arms(
    group: &mut Group,
    requests: &mut Vec<Request>,
    moments: &MomentBalance,
    room: &mut RoomOfArms<'_>,
    (sheet, construction, notation): (&ForceSheet, &Construction, &Notation<'_>),
) {
    let frame = room.frame;
    let about = match moments.about {
        About::Point(point) => match construction.space.places.get(point.0) {
            Some(Some(about)) => page(*about),
            _ => return,
        },
        About::Meet { on, at, .. } => {
            let at = on_page(at, construction);
            let mut meet = Group::new("meet").data("link", notation.number(on));
            meet.mark(
                Mark::outlined(Shape::Circle { centre: at, radius: 0.6 }, Pen::solid(FINE), Tone::Ink)
                    .precise(),
            );
            group.group(meet);
            let site = Site::Around { at, radius: 0.8, toward: None };
            requests.push(Request::new(meet_name(on, notation), LABEL, site, "label meet-name"));
            at
        }
        About::Contact { at, .. } => {
            let at = on_page(at, construction);
            let mut contact = Group::new("meet");
            let spot = Shape::Circle { centre: at, radius: 0.4 };
            contact.mark(Mark::outlined(spot, Pen::solid(FINE), Tone::Ink).precise());
            group.group(contact);
            at
        }
        About::Centre { of, from, at, .. } => {
            let at = on_page(at, construction);
            let mut meet = Group::new("meet").data("link", notation.number(of));
            for end in
                from.map(|end| on_page(end, construction)).into_iter().filter(|end| end.distance(at) > 1.0)
            {
                let past = at + (at - end).normalize() * 3.0;
                let line = Shape::Line(end, past);
                meet.mark(Mark::stroke(line, Pen { width: FINE, dash: Dash::Dashed }).precise());
            }
            let spot = Shape::Circle { centre: at, radius: 0.6 };
            meet.mark(Mark::outlined(spot, Pen::solid(FINE), Tone::Ink).precise());
            group.group(meet);
            let site = Site::Around { at, radius: 0.8, toward: None };
            requests.push(Request::new(centre_name(), LABEL, site, "label meet-name"));
            at
        }
    };
    let mut drawn: Vec<Arm> = Vec::new();
    for term in moments.terms.iter().chain([&moments.found]) {
        let Some(arm) = term
            .arm
            .filter(|arm| arm.between.is_none() && !drawn.contains(arm) && !is_a_couple(arm, construction))
        else {
            continue;
        };
        drawn.push(arm);
        let foot = on_page(arm.foot, construction);
        if foot.distance(about) < SHORTEST {
            continue;
        }
        let whole = frame.0.contains(foot);
        let foot = if whole { foot } else { frame.cut(about, foot) };
        let mut own =
            Group::new("arm").data("value", format!("{}", arm.length / notation.scene.units.length.si));
        let (from, to) = room.stand((about, foot), direction_of(sheet, term.of));
        own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).precise());
        let along = (foot - about).normalize();
        own.mark(super::ink::head(to, along, 2.0));
        own.mark(super::ink::head(from, -along, 2.0));
        // What stands beside the link has lines that lead there.
        for (end, moved) in [(about, from), (foot, to)].into_iter().filter(|(end, moved)| end != moved) {
            let past = moved + (moved - end).normalize();
            own.mark(Mark::stroke(Shape::Line(end, past), Pen::solid(FINE)).precise());
        }
        // The line of the force as far as the foot, and a little past it.
        let pin = moments.carried.and_then(|(_, pin)| *construction.space.places.get(pin.0)?).map(page);
        let through = moments_line(sheet, term.of, (foot, pin), construction)
            .filter(|at| whole && frame.0.contains(*at));
        if let Some(at) = through.filter(|at| at.distance(foot) > 1.0) {
            let past = foot + (foot - at).normalize() * 2.0;
            own.mark(Mark::stroke(Shape::Line(at, past), Pen { width: FINE, dash: Dash::Dashed }).precise());
        }
        group.group(own);
        let name = arm_name(sheet, &arm, notation);
        let mut request = Request::new(name, SMALL, Site::Along { from, to }, "label arm-name");
        request.leader = true;
        requests.push(request);
    }
}

/// The point in which three forces meet, and their lines as far as that; no farther than a drawing reaches.
fn three_forces(
    group: &mut Group,
    requests: &mut Vec<Request>,
    meet: &MeetOfThree,
    (acting, couples, construction): (&[Acting], bool, &Construction),
    notation: &Notation<'_>,
) {
    /// What lies farther off is off the drawing, mm.
    const REACH: f64 = 120.0;
    let at = on_page(meet.at, construction);
    let mut own = Group::new("meet").data("link", notation.number(meet.link));
    let mut reached = false;
    let known: Vec<&Acting> = acting.iter().filter(|acting| !acting.closes).collect();
    let resultant = on_page(meet.through, construction);
    let found = acting.iter().filter(|acting| acting.closes);
    let lines = found.map(|acting| on_page(acting.through, construction)).chain([resultant]);
    // As far as a line is drawn.
    let reach = |from: Point| {
        let away = from.distance(at);
        if away > REACH { from + (at - from) * (REACH / 2.0 / away) } else { at }
    };
    if known.len() > 1 || couples {
        let site = Site::Along { from: resultant, to: reach(resultant) };
        let mut request = Request::new(resultant_name(meet.link, notation), LABEL, site, "label force-name");
        request.leader = true;
        requests.push(request);
    }
    for from in lines {
        if from.distance(at) < SHORTEST {
            continue;
        }
        let end = reach(from);
        reached |= end == at;
        own.mark(Mark::stroke(Shape::Line(from, end), Pen { width: FINE, dash: Dash::Dashed }).precise());
    }
    if reached {
        own.mark(
            Mark::outlined(Shape::Circle { centre: at, radius: 0.6 }, Pen::solid(FINE), Tone::Ink).precise(),
        );
        let site = Site::Around { at, radius: 0.8, toward: None };
        requests.push(Request::new(meet_name(meet.link, notation), LABEL, site, "label meet-name"));
    }
    group.group(own);
}

/// The couples that are known to act on a body.
pub(super) fn couples_on(body: &FreeBody) -> Vec<(Force, f64)> {
    let known = |(force, value): &&(Force, f64)| !matches!(force, Force::Torque(_)) && *value != 0.0;
    body.torques.iter().filter(known).copied().collect()
}

/// The name of the resultant of what is known to act on a link.
pub fn resultant_name(on: LinkId, notation: &Notation<'_>) -> Rich {
    Rich::italic("R").sub(&notation.number(on))
}

/// The name of the instantaneous centre about which the moments of an arm are taken.
pub fn centre_name() -> Rich {
    Rich::italic("I")
}

/// The name of the point in which the lines of two forces on a link meet.
pub fn meet_name(on: LinkId, notation: &Notation<'_>) -> Rich {
    Rich::italic("K").sub(&notation.number(on))
}

/// The force that acts on a sheet, or a sum of such, with its line.
fn drawn(sheet: &ForceSheet, action: Action) -> Option<Acting> {
    let all = sheet.bodies.iter().flat_map(|body| &body.acting).chain(&sheet.inertia).chain(&sheet.frame);
    let one = all.into_iter().find(|acting| acting.action == action).copied();
    one.or_else(|| match action {
        Action::Shaking => sum_on_its_line(action, &sheet.inertia, sheet.shaking.as_ref()?),
        Action::OnFrame => sum_on_its_line(action, &sheet.frame, sheet.frame_line.as_ref()?),
        _ => None,
    })
}

/// Whither a force of a moment points on the page; none of a part of one, or a couple.
fn direction_of(sheet: &ForceSheet, of: Turning) -> Option<Vec2> {
    let Turning::Force(action) = of else { return None };
    drawn(sheet, action).map(|acting| Vec2::new(acting.force[0], -acting.force[1]))
}

/// Where a force of a moment stands on the skeleton; the pin to which it is carried, where its own line does not lead to
/// the foot of its arm.
fn moments_line(
    sheet: &ForceSheet,
    of: crate::graphical::construction::Turning,
    (foot, pin): (Point, Option<Point>),
    construction: &Construction,
) -> Option<Point> {
    let (Turning::Force(action) | Turning::Along(action) | Turning::Across(action)) = of else { return None };
    let Some(acting) = drawn(sheet, action) else {
        // What the links of a pin exert on it is not drawn one by one, and passes through it.
        let (Action::OnPin(_, at) | Action::OfPin(at, _)) = action else { return None };
        return construction.space.places.get(at.0).copied().flatten().map(page);
    };
    let through = on_page(acting.through, construction);
    let along = page(acting.force) - page([0.0; 2]);
    let off = (foot - through).cross(along).abs();
    let leads = off <= OFF_LINE * along.hypot();
    Some(pin.filter(|_| !leads && matches!(of, Turning::Force(_))).unwrap_or(through))
}

/// One or more bodies cut free, with what acts on them.
struct Free<'a> {
    of: &'a [Party],
    acting: &'a [Acting],
    torques: &'a [(Force, f64)],
    moments: &'a [&'a MomentBalance],
}

impl Free<'_> {
    /// Where forces act on these bodies that are none of their own points: what slides on their guides, and where they roll,
    /// each with its name.
    fn touched(&self, construction: &Construction, notation: &Notation<'_>) -> Vec<(Point, Rich)> {
        let m = notation.mechanism();
        let of = |link: LinkId| self.of.contains(&Party::Link(link));
        let riders =
            m.slides.iter().filter(|slide| of(slide.guide.link)).filter_map(|slide| match slide.rider {
                Rider::Pin { point, .. } => Some(point),
                Rider::Link { link, .. } => m.link(link).points.first().copied(),
            });
        let rolling = m.rolls.iter().zip(&m.contacts).filter(|(roll, _)| roll.bodies().into_iter().any(of));
        let mut found: Vec<(Point, Rich)> = Vec::new();
        for point in riders.chain(rolling.map(|(_, contact)| *contact)) {
            let Some(Some(at)) = construction.space.places.get(point.0) else { continue };
            let at = page(*at);
            let acts = |acting: &Acting| {
                [acting.at, acting.through]
                    .iter()
                    .any(|place| on_page(*place, construction).distance(at) < 1.0)
            };
            if self.acting.iter().any(acts) && found.iter().all(|(other, _)| other.distance(at) > 1.0) {
                found.push((at, notation.point(point)));
            }
        }
        found
    }

    fn draw(&self, sheet: &ForceSheet, construction: &Construction, notation: &Notation<'_>) -> Group {
        let mechanism = notation.mechanism();
        let mut group = Group::new("free-body");
        let mut requests: Vec<Request> = Vec::new();
        let mut places: Vec<(Point, Rich, bool)> = Vec::new();
        let mut all_bars: Vec<Stretch> = Vec::new();
        let mut all_places: Vec<Vec<Point>> = Vec::new();
        for party in self.of {
            let points = match *party {
                Party::Link(link) => mechanism.link(link).points.clone(),
                Party::Pin(pin) => vec![pin],
            };
            let own: Vec<(Point, Rich, bool)> = points
                .iter()
                .filter_map(|point| {
                    let at = (*construction.space.places.get(point.0)?)?;
                    Some((page(at), notation.point(*point), mechanism.is_pin(*point)))
                })
                .collect();
            match *party {
                Party::Link(link) => {
                    if self.of.len() == 1 {
                        group = group.data("link", notation.number(link));
                    }
                    // As long as what slides on it, or in it, stands.
                    let slides = mechanism.slides.iter().filter(|slide| slide.guide.link == link);
                    let mut riders: Vec<Point> = slides
                        .filter_map(|slide| {
                            let rider = match slide.rider {
                                Rider::Pin { point, .. } => point,
                                Rider::Link { link, .. } => *mechanism.link(link).points.first()?,
                            };
                            Some(page((*construction.space.places.get(rider.0)?)?))
                        })
                        .collect();
                    riders.extend(contact_of_rack(link, construction, notation));
                    let stand = drawn_by(&own, &riders);
                    all_bars.extend(bars(&stand));
                    all_places.push(stand);
                    wheels(&mut group, link, construction, notation);
                    draw_link(&mut group, link, &own, &riders, construction, notation);
                    friction::circles_on(&mut group, link, sheet, construction, notation);
                }
                Party::Pin(pin) => {
                    let mut circle = Group::new("pin").data("point", notation.point_name(pin));
                    for (at, ..) in &own {
                        let shape = Shape::Circle { centre: *at, radius: 1.4 };
                        circle.mark(Mark::outlined(shape, Pen::solid(THIN), Tone::Paper).precise());
                    }
                    group.group(circle);
                }
            }
            for place in own {
                if places.iter().all(|(at, ..)| at.distance(place.0) > 0.2) {
                    places.push(place);
                }
            }
        }
        let touched = self.touched(construction, notation);
        for (at, name) in touched.clone() {
            if places.iter().all(|(other, ..)| other.distance(at) > 1.0) {
                let mut own = Group::new("touched");
                own.mark(dot(at, 0.6).precise());
                group.group(own);
                requests.push(Request::new(
                    name,
                    LABEL,
                    Site::Around { at, radius: 1.2, toward: None },
                    "label point-name",
                ));
            }
        }
        for (at, name, _) in &places {
            requests.push(Request::new(
                name.clone(),
                LABEL,
                Site::Around { at: *at, radius: 1.2, toward: None },
                "label point-name",
            ));
        }
        let Some(ink) = group.bounds() else { return group };
        let frame = Frame::around(ink);
        let mut room = RoomOfArms { frame, bars: &all_bars, aside: Vec::new() };
        for moments in self.moments {
            arms(&mut group, &mut requests, moments, &mut room, (sheet, construction, notation));
        }
        let of_link = |link: LinkId| self.of.contains(&Party::Link(link));
        for meet in sheet.meets.iter().filter(|meet| of_link(meet.link)) {
            let couples = sheet.bodies.get(meet.told).is_some_and(|body| !couples_on(body).is_empty());
            three_forces(&mut group, &mut requests, meet, (self.acting, couples, construction), notation);
        }
        let everything: Vec<Acting> = sheet.bodies.iter().flat_map(|body| body.acting.clone()).collect();
        let most = largest(&everything);
        let mut taken = Vec::new();
        // An arm that a moment takes leads to a line that lies far off, and says how far.
        let by_arm = |acting: &Acting| {
            let takes = |moments: &&&MomentBalance| {
                let mut terms = moments.terms.iter().chain([&moments.found]);
                terms.any(|term| {
                    let drawn = |arm: Arm| arm.between.is_none() && !is_a_couple(&arm, construction);
                    term.of == Turning::Force(acting.action) && term.arm.is_some_and(drawn)
                })
            };
            match self.moments.iter().find(takes)?.about {
                About::Point(point) => construction.space.places.get(point.0).copied().flatten().map(page),
                About::Meet { at, .. } | About::Contact { at, .. } | About::Centre { at, .. } => {
                    Some(on_page(at, construction))
                }
            }
        };
        let near = |acting: &Acting| {
            let on_line = on_page(acting.through, construction);
            let places = places.iter().map(|(at, ..)| *at);
            let nearest = places.min_by(|a, b| a.distance(on_line).total_cmp(&b.distance(on_line)));
            (on_line, by_arm(acting).or(nearest))
        };
        // Where all arrows stand tells where the name of each one does.
        let full = |acting: &&Acting| acting.known == Knowledge::Full;
        let arrows: Vec<Point> = self
            .acting
            .iter()
            .filter(full)
            .map(|acting| {
                let (on_line, near) = near(acting);
                let (Stand::At(at) | Stand::Border(at)) = frame.stand(acting, on_line, near);
                off_the_link((&all_bars, &mut taken), acting, at, most)
            })
            .collect();
        give_way(&mut group, &taken);
        let mut arrows = arrows.into_iter();
        let strokes: Vec<Stretch> = all_bars.iter().chain(&room.aside).copied().collect();
        // What has neither a size nor a line finds its place beside all that has.
        let mut in_turn: Vec<&Acting> = self.acting.iter().collect();
        in_turn.sort_by_key(|acting| acting.known == Knowledge::Nothing && acting.parts.is_none());
        for acting in in_turn {
            let (on_line, near) = near(acting);
            let at = match frame.stand(acting, on_line, near) {
                Stand::At(at) => {
                    // What stands alone in the blank says how far off it is, from what is nearest to its line.
                    let points = places.iter().map(|(at, ..)| *at).chain(touched.iter().map(|(at, _)| *at));
                    let feet = points.filter_map(|at| Some((at, foot_on(acting, on_line, at)?)));
                    let away = |(place, foot): &(Point, Point)| place.distance(*foot);
                    let nearest = feet.min_by(|a, b| away(a).total_cmp(&away(b)));
                    if let Some((place, foot)) = nearest.filter(|feet| away(feet) > ALONE)
                        && tells_line(acting)
                        && by_arm(acting).is_none()
                    {
                        let force = (acting, on_line, foot);
                        far_off(&mut group, &mut requests, force, Some(place), (construction, notation));
                    }
                    at
                }
                Stand::Border(border) if tells_line(acting) => {
                    if by_arm(acting).is_none() {
                        let force = (acting, on_line, border);
                        far_off(&mut group, &mut requests, force, near, (construction, notation));
                    }
                    border
                }
                Stand::Border(_) => on_page(acting.at, construction),
            };
            match acting.known {
                Knowledge::Full => {
                    let at = arrows.next().unwrap_or(at);
                    short_arrow(&mut group, &mut requests, acting, at, (most, &taken), notation);
                }
                // What passes on no force but a couple has neither a line nor a wave.
                _ if acting.couple != 0.0 => {}
                known => match acting.parts {
                    Some(parts) => {
                        let shown = (construction, notation);
                        let drawn = (&mut group, &mut requests);
                        taken.extend(lines_of_parts(drawn, (acting, parts), (at, &places), shown));
                    }
                    None => {
                        let around = (&places[..], &strokes[..], &taken[..]);
                        let drawn = (&mut group, &mut requests);
                        let stroke = unknown(drawn, acting, (known, at), around, notation);
                        taken.push(stroke);
                    }
                },
            }
        }
        let ink = group.bounds().unwrap_or(Rect::ZERO);
        let first = places.first().map_or(ink.center(), |(at, ..)| *at);
        let torques = self.torques.iter().map(|(torque, value)| {
            let known = !matches!(torque, Force::Torque(_));
            (first, *torque, *value, known)
        });
        // A couple stands anywhere on its body.
        let on_body = |at: Point| {
            let beside = |place: Point| at.distance(place);
            let on_bar = all_places.iter().flat_map(|places| spans(places)).any(|(a, b)| {
                let along = (b - a).normalize();
                let reach = (at - a).dot(along).clamp(0.0, a.distance(b));
                at.distance(a + along * reach) < 1.0
            });
            let nearest = places.iter().map(|(place, ..)| *place);
            let nearest = nearest.min_by(|a, b| beside(*a).total_cmp(&beside(*b)));
            if on_bar { at } else { nearest.unwrap_or(at) }
        };
        let couples = self.acting.iter().filter_map(|acting| {
            let couple = couple_name(sheet, acting)?;
            let at = on_body(on_page(acting.at, construction));
            Some((at, couple, acting.couple, acting.known == Knowledge::Full))
        });
        let mut arcs: Vec<Point> = Vec::new();
        for (at, torque, value, known) in torques.chain(couples) {
            let here = arcs.iter().filter(|other| other.distance(at) < ABOUT_ONE).count();
            let radius = 4.5 + 1.8 * here as f64;
            arcs.push(at);
            turning(&mut group, &mut requests, (torque, value, known), (at, radius), notation);
        }
        let names = place(&group, &requests, None);
        group.group(names);
        group
    }
}

/// The name of the couple that a pair passes on without a force: the moment by which a balance has told it; none of a force.
fn couple_name(sheet: &ForceSheet, acting: &Acting) -> Option<Force> {
    let told = sheet.moments.iter().find_map(|moments| match moments.found.of {
        Turning::Torque(Force::Moment(of, about)) if either(of) == either(acting.action) => Some(about),
        _ => None,
    });
    (acting.couple != 0.0).then_some(Force::Moment(acting.action, told?))
}

/// The lines of the parts of a force that is not found: from where it acts, that along a link away from it.
fn lines_of_parts(
    (group, requests): (&mut Group, &mut Vec<Request>),
    (acting, parts): (&Acting, Parts),
    (at, places): (Point, &[(Point, Rich, bool)]),
    (construction, notation): (&Construction, &Notation<'_>),
) -> Vec<Stretch> {
    let profile = notation.profile;
    let mut drawn = Vec::new();
    // A part that comes to nothing has the line that the table gives it.
    let [from, to] = parts.line.map(|point| construction.space.places.get(point.0).copied().flatten());
    let bar = from.zip(to).map(|([ax, ay], [bx, by])| [bx - ax, by - ay]);
    let square = bar.map(|[x, y]| [-y, x]);
    let both = [(parts.across, square, "Ft", profile.tangential), (parts.along, bar, "Fn", profile.normal)];
    for (force, line, letters, mark) in both {
        let force = if force == [0.0; 2] { line.unwrap_or(force) } else { force };
        let size = libm::hypot(force[0], force[1]);
        if size <= 0.0 {
            continue;
        }
        let along = Vec2::new(force[0] / size, -force[1] / size);
        let on_link = places.iter().any(|(place, ..)| {
            let to = *place - at;
            to.hypot() > 1.0 && to.normalize().dot(along) > 0.9
        });
        let along = if on_link { -along } else { along };
        let to = at + along * LINE;
        let mut own = Group::new("force line").data("quantity", part_name(letters, acting, parts, notation));
        own.mark(Mark::stroke(Shape::Line(at, to), Pen::solid(THIN)).precise());
        group.group(own);
        let toward = Some(libm::atan2(-along.y, along.x));
        let text = super::force_names::part(notation, acting.action, mark);
        let site = Site::Around { at: to, radius: 0.8, toward };
        let mut request = Request::new(text, SMALL, site, "label force-name");
        request.leader = true;
        requests.push(request);
        drawn.push((at, to));
    }
    drawn
}

/// The joints of what is cut free, the strokes of its links, and those of the forces that are drawn on it.
type Around<'a> = (&'a [(Point, Rich, bool)], &'a [Stretch], &'a [Stretch]);

/// A force of which only the line is known, or nothing but where it acts: its stroke.
fn unknown(
    (group, requests): (&mut Group, &mut Vec<Request>),
    acting: &Acting,
    (known, at): (Knowledge, Point),
    (places, bars, taken): Around<'_>,
    notation: &Notation<'_>,
) -> Stretch {
    let mechanism = notation.mechanism();
    let size = libm::hypot(acting.force[0], acting.force[1]);
    if known == Knowledge::Line && size > 0.0 {
        let along = Vec2::new(acting.force[0] / size, -acting.force[1] / size);
        // Along the link itself it stands outside of it.
        let covered = |way: Vec2| bars.iter().any(|bar| lies_on((at, at + way * LINE), *bar));
        let along = if covered(along) && !covered(-along) { -along } else { along };
        let back = if covered(-along) { 0.0 } else { 0.5 * LINE };
        let (from, to) = (at - along * back, at + along * LINE);
        let mut own = Group::new("force line").data("quantity", acting.action.name(mechanism));
        own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(THIN)).precise());
        group.group(own);
        named(requests, acting, to, along, notation);
        return (from, to);
    }
    // Away from the middle of the link, where there is room.
    let middle =
        places.iter().fold(Vec2::ZERO, |sum, (p, ..)| sum + p.to_vec2()) / places.len().max(1) as f64;
    let away = at.to_vec2() - middle;
    // What is cut free as a point has its known lines along the axes, mostly.
    let aslant = Vec2::new(0.8, -0.6);
    let mut along = if away.hypot() > 1.0 { away.normalize() } else { aslant };
    // Not along the link itself.
    let covered = places.iter().any(|(p, ..)| {
        let to = *p - at;
        to.hypot() > 1.0 && to.normalize().dot(along) > 0.9
    });
    if covered {
        along = Vec2::new(-along.y, along.x);
    }
    // Nor along another force: turned away from it, as little as may be.
    let stroke = |turned: f64| {
        let (sin, cos) = (libm::sin(turned), libm::cos(turned));
        let way = Vec2::new(along.x * cos - along.y * sin, along.x * sin + along.y * cos);
        (at, at + way * LINE)
    };
    let free = |stroke: &Stretch| !taken.iter().chain(bars).any(|other| waves_over(*stroke, *other));
    let turns = (0..=TURNS_OF_A_WAVE).flat_map(|step| {
        let turned = std::f64::consts::PI * f64::from(step) / f64::from(TURNS_OF_A_WAVE);
        [turned, -turned]
    });
    let found = if free(&stroke(0.0)) { None } else { turns.map(stroke).find(free) };
    along = found.map_or(along, |(from, to)| (to - from) / LINE);
    let mut own = Group::new("force unknown").data("quantity", acting.action.name(mechanism));
    own.mark(Mark::stroke(Shape::Polyline(wave(at, along)), Pen::solid(THIN)));
    group.group(own);
    named(requests, acting, at + along * LINE, along, notation);
    (at, at + along * LINE)
}

/// In so many steps a wave is turned half round from where it would stand.
const TURNS_OF_A_WAVE: u32 = 6;

/// Whether the wave of an unknown force would lie on another stroke: more of it than where both begin is nearer to it than
/// it swings.
fn waves_over((from, to): Stretch, (a, b): Stretch) -> bool {
    const PARTS: u32 = 20;
    const SWING: f64 = 2.0;
    const MOST: usize = 8;
    let length = a.distance(b);
    if length <= 0.0 {
        return false;
    }
    let along = (b - a) / length;
    let near = |part: &u32| {
        let at = from.lerp(to, f64::from(*part) / f64::from(PARTS));
        let reach = (at - a).dot(along).clamp(0.0, length);
        at.distance(a + along * reach) < SWING
    };
    (0..=PARTS).filter(near).count() > MOST
}

/// The inertia torque of a link, where a free body shows it.
fn couple_of(sheet: &ForceSheet, link: LinkId) -> Option<f64> {
    let torques =
        sheet.bodies.iter().filter(|body| body.of == Party::Link(link)).flat_map(|body| &body.torques);
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

/// The circles of a link that rolls.
fn wheels(group: &mut Group, link: LinkId, construction: &Construction, notation: &Notation<'_>) {
    let circles = |roll: &Roll| match roll {
        Roll::Circles { links, centres, radii, .. } => {
            [0, 1].map(|i| (links[i], centres[i], radii[i].value)).to_vec()
        }
        Roll::Line { wheel, centre, radius, .. } => vec![(*wheel, *centre, radius.value)],
    };
    let mut drawn: Vec<(Point, f64)> = Vec::new();
    for (_, centre, radius) in
        notation.mechanism().rolls.iter().flat_map(circles).filter(|(body, ..)| *body == link)
    {
        let Some(Some(centre)) = construction.space.places.get(centre.0) else { continue };
        let circle = (page(*centre), radius / construction.space.metres_per_mm);
        if !drawn.contains(&circle) {
            drawn.push(circle);
        }
    }
    for (centre, radius) in drawn {
        let mut own = Group::new("wheel").data("link", notation.number(link));
        own.mark(Mark::stroke(Shape::Circle { centre, radius }, Pen::solid(THIN)).precise());
        group.group(own);
    }
}

/// Where wheels touch the line of a link.
fn contact_of_rack(link: LinkId, construction: &Construction, notation: &Notation<'_>) -> Vec<Point> {
    let m = notation.mechanism();
    let lines = m.rolls.iter().zip(&m.contacts).filter_map(|(roll, contact)| match roll {
        Roll::Line { guide, .. } if guide.link == link => {
            construction.space.places.get(contact.0).copied().flatten()
        }
        _ => None,
    });
    lines.map(page).collect()
}

/// How a block lies: along the guide on which it slides; another link of one place along the guide that it carries.
fn along_guide(link: LinkId, construction: &Construction, notation: &Notation<'_>) -> Vec2 {
    let m = notation.mechanism();
    let pose = Pose::new(m, &construction.space);
    let slides = || m.slides.iter();
    let own = slides().find(|slide| m.party_of(&slide.rider) == Party::Link(link));
    let guide = own.or_else(|| slides().find(|slide| slide.guide.link == link));
    match guide.and_then(|slide| pose.guide(slide)) {
        Some(GuideLine::Straight { along, .. }) => along,
        Some(GuideLine::Arc { at, centre }) if at.distance(centre) > 0.0 => {
            let outward = (at - centre).normalize();
            Vec2::new(-outward.y, outward.x)
        }
        Some(GuideLine::Arc { .. }) | None => Vec2::new(1.0, 0.0),
    }
}

/// A link by its points: a stroke from joint to joint, a block as a box along its guide.
fn draw_link(
    group: &mut Group,
    link: LinkId,
    places: &[(Point, Rich, bool)],
    riders: &[Point],
    construction: &Construction,
    notation: &Notation<'_>,
) {
    /// Half the length and half the breadth of a block, mm.
    const BLOCK: (f64, f64) = (3.0, 2.1);
    let mut own = Group::new("link").data("link", notation.number(link));
    let points = drawn_by(places, riders);
    let rolls = notation.mechanism().rolls.iter().any(|roll| roll.bodies().contains(&link));
    let is_block = riders.is_empty() && !rolls;
    match Outline::of(&points) {
        Outline::Spot if is_block => {
            for (at, ..) in places {
                let along = along_guide(link, construction, notation);
                let corners = super::ink::turned_rect(*at, along, BLOCK.0, BLOCK.1);
                own.mark(Mark::outlined(Shape::Polygon(corners), Pen::solid(THIN), Tone::Paper));
            }
        }
        Outline::Spot => points.iter().for_each(|at| own.mark(dot(*at, 0.6).precise())),
        Outline::Bar((from, to)) => {
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(THICK)).precise());
        }
        Outline::Plate(corners) => {
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

/// The ends of points on one line.
fn in_line(points: &[Point]) -> Option<[Point; 2]> {
    let mut ends: Option<[Point; 2]> = None;
    for (i, a) in points.iter().enumerate() {
        for b in &points[..i] {
            if ends.is_none_or(|[c, d]| a.distance(*b) > c.distance(d)) {
                ends = Some([*b, *a]);
            }
        }
    }
    let [a, b] = ends.filter(|_| points.len() > 2)?;
    let along = (b - a).normalize();
    points.iter().all(|point| (*point - a).cross(along).abs() < 0.4).then_some([a, b])
}

/// Where forces of one line run back over each other, each has a lane of its own beside the line: how far aside each lies.
/// Of a polygon that is not all in one line nothing is moved.
fn lanes(strokes: &[Stretch]) -> Vec<Vec2> {
    /// What is nearer to a line than this is on it, and what lies over each other by less does not, mm.
    const ON: f64 = 0.4;
    /// From lane to lane, mm: arrowheads are clear of each other.
    const APART: f64 = 2.4;
    let none = || vec![Vec2::ZERO; strokes.len()];
    let length = |(from, to): &Stretch| from.distance(*to);
    let Some(longest) = strokes.iter().max_by(|a, b| length(a).total_cmp(&length(b))) else { return none() };
    if length(longest) < SHORTEST {
        return none();
    }
    let along = (longest.1 - longest.0).normalize();
    let ends = || strokes.iter().flat_map(|(from, to)| [*from, *to]);
    if ends().any(|end| end.to_vec2().cross(along).abs() > ON) {
        return none();
    }
    let across = Vec2::new(-along.y, along.x);
    // Downward, else to the right.
    let across =
        if across.y < -1e-9 || (across.y.abs() <= 1e-9 && across.x < 0.0) { -across } else { across };
    let mut taken: Vec<(usize, f64, f64)> = Vec::new();
    let mut lane = |stroke: &Stretch| {
        if length(stroke) < SHORTEST {
            return Vec2::ZERO;
        }
        let [a, b] = [stroke.0, stroke.1].map(|end| end.to_vec2().dot(along));
        let (low, high) = (a.min(b), a.max(b));
        let free = |lane: &usize| {
            taken.iter().all(|(other, from, to)| other != lane || high.min(*to) - low.max(*from) < ON)
        };
        let own = (0..=taken.len()).find(free).unwrap_or_default();
        taken.push((own, low, high));
        across * (APART * own as f64)
    };
    strokes.iter().map(&mut lane).collect()
}

/// Fine lines from where one force ends to where the next one begins in another lane, and from the end of the last one back
/// to the pole.
fn between_lanes(strokes: &[Stretch], lanes: &[Vec2]) -> Group {
    /// What is nearer than this is one place, mm.
    const ONE: f64 = 0.05;
    let mut all = Group::default();
    let own = || strokes.iter().zip(lanes);
    let next = own().skip(1).map(|((from, _), lane)| (*from, *lane)).chain([(Point::ORIGIN, Vec2::ZERO)]);
    for (((_, end), lane), (begin, other)) in own().zip(next) {
        if end.distance(begin) < ONE && lane != &other {
            let line = Shape::Line(*end + *lane, begin + other);
            all.mark(Mark::stroke(line, Pen::solid(FINE)).precise());
        }
    }
    all
}

/// Forces head to tail from the pole: thick what was known, thin what was found; with their sum where one is sought.
fn polygon(
    acting: &[Acting],
    sum: Option<Quantity>,
    pole: &Rich,
    (panel, sheet): (ForcePanel, &ForceSheet),
    notation: &Notation<'_>,
) -> Group {
    let unit = &notation.scene.units.force;
    let Some(per_mm) = per_mm(sheet, panel, notation) else { return Group::new("force polygon") };
    let mut group = Group::new("force polygon")
        .data("scale", format!("{}", per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol))
        .data("si-per-mm", format!("{per_mm}"));
    let mut requests = Vec::new();
    let Some(places) = chain(acting) else { return group };
    let place_of = |newtons: [f64; 2]| page(newtons.map(|n| n / per_mm));
    let strokes = strokes(acting, (panel, sheet), notation);
    let mut on_paper: Vec<Stretch> =
        strokes.iter().map(|stroke| (place_of(stroke.ends[0]), place_of(stroke.ends[1]))).collect();
    on_paper.extend(places.last().filter(|_| sum.is_some()).map(|last| (Point::ORIGIN, place_of(*last))));
    let lanes = lanes(&on_paper);
    let in_lane: Vec<Stretch> =
        on_paper.iter().zip(&lanes).map(|((from, to), lane)| (*from + *lane, *to + *lane)).collect();
    group.adopt(between_lanes(&on_paper, &lanes));
    for (stroke, &(from, to)) in strokes.iter().zip(&in_lane) {
        let mut own = Group::new(match stroke.of {
            Laid::Known => "vector force known",
            Laid::Found => "vector force found",
            Laid::Sum => "vector force sum",
        })
        .data("quantity", stroke.quantity.clone())
        .data("value", format!("{}", stroke.length() / unit.si));
        if from.distance(to) < SHORTEST {
            own = own.data("as-point", "true");
            own.mark(dot(to, 0.55).precise());
        } else {
            arrow(&mut own, from, to, if stroke.of == Laid::Known { THICK } else { THIN });
        }
        group.group(own);
        let text = stroke.symbol.clone();
        let mut request = Request::new(text, SMALL, Site::Along { from, to }, "label vector-name");
        // Of parts and a sum that lie next to each other each keeps its name, on a leader if need be.
        request.strict = stroke.in_parts;
        if from.distance(to) < CROWDED {
            let at = from.midpoint(to);
            request = Request { sites: vec![Site::Around { at, radius: 1.2, toward: None }], ..request };
        }
        request.leader = true;
        if from.distance(to) >= SHORTEST {
            requests.push(request.naming([stroke.quantity.clone()]));
        }
    }
    let sides: Vec<&Stroke> = strokes.iter().filter(|stroke| stroke.of != Laid::Sum).collect();
    // Two lines that meet run past their meeting.
    let found: Vec<usize> = (0..sides.len()).filter(|i| sides[*i].of == Laid::Found).collect();
    if let ([first, second], None) = (&found[..], sum)
        && second - first == 1
    {
        let mut own = Group::new("construction");
        let meet = place_of(sides[*first].ends[1]);
        for end in [place_of(sides[*first].ends[0]), place_of(sides[*second].ends[1])] {
            if meet.distance(end) > SHORTEST {
                let past = meet + (meet - end).normalize() * PAST;
                own.mark(Mark::stroke(Shape::Line(meet, past), Pen::solid(FINE)).precise());
            }
        }
        group.group(own);
    }
    if let (Some(quantity), Some(last)) = (sum, places.last()) {
        let lane = lanes.last().copied().unwrap_or_default();
        let (from, to) = (Point::ORIGIN + lane, place_of(*last) + lane);
        let size = libm::hypot(last[0], last[1]);
        let mut own = Group::new("vector force sum")
            .data("quantity", quantity.name(notation.mechanism()))
            .data("value", format!("{}", size / unit.si));
        arrow(&mut own, from, to, THICK);
        group.group(own);
        if from.distance(to) >= SHORTEST {
            let text = notation.symbol(quantity, false);
            let mut request = Request::new(text, SMALL, Site::Along { from, to }, "label vector-name");
            request.leader = true;
            requests.push(request.naming([quantity.name(notation.mechanism())]));
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
    let aside = |stroke: &Stroke| {
        let own = strokes.iter().position(|other| std::ptr::eq(other, stroke));
        own.map_or(Vec2::ZERO, |own| lanes[own])
    };
    let sides: Vec<Side> = sides
        .into_iter()
        .filter(|stroke| stroke.length() > 0.0)
        .map(|stroke| Side {
            from: place_of(stroke.ends[0]) + aside(stroke),
            to: place_of(stroke.ends[1]) + aside(stroke),
            name: stroke.symbol.clone(),
            known: stroke.of == Laid::Known,
        })
        .collect();
    force_detail::add(&mut group, &sides, CROWDED, notation);
    group
}

/// The loads and springs that a scene states, on the skeleton of a question: every arrow of one length, and only where the
/// scene says whither it points.
pub fn stated(
    notation: &Notation<'_>,
    place: impl Fn(crate::mechanism::PointId) -> Option<Point>,
) -> (Group, Vec<Request>) {
    let mechanism = notation.mechanism();
    let mut group = Group::new("forces");
    let mut requests = Vec::new();
    for (index, load) in mechanism.forces.loads.iter().enumerate() {
        let turned = |size: &Size| match size {
            Size::Given(given) => Some(given.value),
            _ => None,
        };
        if let LoadKind::Torque { size, with_motion: None } = &load.kind
            && let Some(value) = turned(size)
            && let Some(at) = mechanism.link(load.link).points.first().and_then(|first| place(*first))
        {
            turning(&mut group, &mut requests, (Force::LoadTorque(index), value, true), (at, 6.5), notation);
        }
        let Some((at, along)) = load.at().and_then(&place).zip(stated_direction(load, &place)) else {
            continue;
        };
        let on_link: Vec<Point> = mechanism.link(load.link).points.iter().filter_map(|p| place(*p)).collect();
        let covered =
            |from: Point| bars(&on_link).iter().any(|bar| lies_on((from, from + along * ARROWS.1), *bar));
        // What pushes along the link stands outside of it with its head at its place.
        let outside = at - along * (ARROWS.1 + 1.4);
        let at = if covered(at) && !covered(outside) { outside } else { at };
        let to = at + along * ARROWS.1;
        blank_under((at, to), &bars(&on_link)).into_iter().for_each(|blank| group.mark(blank));
        let mut own = Group::new("force applied").data("quantity", Action::Load(index).name(mechanism));
        arrow(&mut own, at, to, THICK);
        group.group(own);
        let toward = Some(libm::atan2(-along.y, along.x));
        let mut request = Request::new(
            symbol(Action::Load(index), notation),
            SMALL,
            Site::Around { at: to, radius: 1.0, toward },
            "label force-name",
        );
        request.leader = true;
        requests.push(request.or(Site::Along { from: at, to }));
    }
    let (coils, names) = springs(notation, place);
    coils.into_iter().for_each(|coil| group.group(coil));
    requests.extend(names);
    (group, requests)
}

/// Half the width of the ground on which a spring hangs.
const GROUND: f64 = 4.2;

/// The springs of a scene where they stand, with their names.
pub fn springs(
    notation: &Notation<'_>,
    place: impl Fn(crate::mechanism::PointId) -> Option<Point>,
) -> (Vec<Group>, Vec<Request>) {
    let mechanism = notation.mechanism();
    let (mut coils, mut requests) = (Vec::new(), Vec::new());
    for spring in &mechanism.forces.springs {
        let [(one, from), (other, to)] = match spring.kind {
            SpringKind::Pull(ends) => ends,
            SpringKind::Torsion(links) => {
                let pin = mechanism
                    .link(links[1])
                    .points
                    .iter()
                    .find(|point| mechanism.point(**point).links.contains(&links[0]));
                let pin = pin.or(mechanism.link(links[1]).points.first());
                if let Some(at) = pin.and_then(|pin| place(*pin)) {
                    let mut own = Group::new("spring");
                    own.mark(Mark::stroke(Shape::Polyline(spiral(at)), Pen::solid(THIN)));
                    coils.push(own);
                    let site = Site::Around { at, radius: 3.4, toward: None };
                    let mut request =
                        Request::new(Rich::italic(&spring.name), SMALL, site, "label spring-name");
                    request.leader = true;
                    requests.push(request);
                }
                continue;
            }
        };
        let ends = [from, to];
        let (Some(from), Some(to)) = (place(from), place(to)) else { continue };
        if from.distance(to) < 4.0 * SHORTEST {
            continue;
        }
        let mut own = Group::new("spring");
        own.mark(Mark::stroke(Shape::Polyline(coil(from, to)), Pen::solid(THIN)));
        // An end on the frame hangs on the ground, where no pivot has a support already.
        for (link, end, at, other) in [(one, ends[0], from, to), (other, ends[1], to, from)] {
            let bare = mechanism.point(end).links.iter().all(|link| *link == LinkId::FRAME);
            if link == LinkId::FRAME && bare {
                let way = (at - other).normalize();
                let side = Vec2::new(-way.y, way.x) * GROUND;
                own.mark(Mark::stroke(Shape::Line(at + side, at - side), Pen::solid(THICK)));
                hatch_below(&mut own, at + side, at - side);
            }
        }
        coils.push(own);
        let name = Rich::italic(&spring.name);
        let mut request = Request::new(name, SMALL, Site::Along { from, to }, "label spring-name");
        request.leader = true;
        requests.push(request);
    }
    (coils, requests)
}

/// Whither a load points on the page, as the scene says it.
fn stated_direction(
    load: &Load,
    place: &impl Fn(crate::mechanism::PointId) -> Option<Point>,
) -> Option<Vec2> {
    let of_angle = |angle: f64| Vec2::new(libm::cos(angle), -libm::sin(angle));
    match load.kind {
        LoadKind::Force { pointing, size, .. } => {
            let along = match pointing {
                Pointing::World(angle) => of_angle(angle.value),
                Pointing::Own { link, angle } if link == LinkId::FRAME => of_angle(angle.value),
                Pointing::Between { from, to, turned } => {
                    let line = place(to)? - place(from)?;
                    of_angle(libm::atan2(-line.y, line.x) + turned.value)
                }
                Pointing::Own { .. } | Pointing::Motion { .. } => return None,
            };
            let backwards = matches!(size, Size::Given(given) if given.value < 0.0);
            Some(if backwards { -along } else { along })
        }
        LoadKind::Vector { parts: [x, y], of, .. } if of == LinkId::FRAME => {
            let along = Vec2::new(x.value, -y.value);
            (along.hypot() > 0.0).then(|| along.normalize())
        }
        LoadKind::Vector { .. } | LoadKind::Torque { .. } => None,
    }
}

/// A torsion spring about a point, mm.
fn spiral(about: Point) -> Vec<Point> {
    const TURNS: u32 = 2;
    const PARTS: u32 = 24;
    let of = |part: u32| {
        let angle = std::f64::consts::TAU * f64::from(part) / f64::from(PARTS);
        let radius = 1.2 + 1.8 * f64::from(part) / f64::from(PARTS * TURNS);
        about + Vec2::new(libm::cos(angle), -libm::sin(angle)) * radius
    };
    (0..=PARTS * TURNS).map(of).collect()
}

/// A spring as a zigzag between its ends.
fn coil(from: Point, to: Point) -> Vec<Point> {
    const TURNS: u32 = 12;
    let along = to - from;
    let side = Vec2::new(-along.y, along.x).normalize() * 1.4;
    let middle = (1..TURNS).map(|i| {
        let part = 0.2 + 0.6 * f64::from(i) / f64::from(TURNS);
        from + along * part + if i % 2 == 0 { side } else { -side }
    });
    let ends = [from, from + along * 0.2];
    ends.into_iter().chain(middle).chain([from + along * 0.8, to]).collect()
}
