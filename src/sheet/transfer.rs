//! A velocity carried over by instant centres: the strokes on the skeleton, and the steps in words.

use std::cell::RefCell;

use kurbo::{Point, Rect};

use super::centres::taking_in;
use super::circle::{centre_name, name};
use super::figure::{Dash, Group, Mark, Pen, Shape, Tone, on_circle};
use super::human;
use super::ink::{FINE, HEAD, SMALL, THICK, THIN, arrow, dot, head, page};
use super::labels::{Request, Site};
use super::notation::Notation;
use super::overlap::clip;
use super::printed::{Apart, Figures, Key};
use super::reach::{Reach, Window};
use super::rich::Rich;
use super::skeleton::{self, Arrows, Overlay};
use super::steps::Item;
use crate::graphical::construction::{
    Act, Centre, CentrePlace, CircleDiagram, Construction, Mm2, Spot, Transfer, TransferAct, TransferInk,
};
use crate::mechanism::quantity::{DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::{LinkId, PointId};
use crate::plan::chord;

/// Blank around the skeleton in which strokes may end.
pub(super) const BORDER: f64 = 14.0;
/// Blank kept between an end and the border.
pub(super) const BLANK: f64 = 3.0;
/// The figure grows to this size at most for the strokes, on upright A4.
pub(super) const LARGEST: (f64, f64) = (160.0, 140.0);
/// Shorter arrows than this are drawn as points.
const SHORTEST: f64 = 1.0;
/// Places nearer to each other than this are one.
const TOGETHER: f64 = 0.3;
/// A centre that is no farther from the middle of a skeleton than so many times its size lies beside it.
const FAR: f64 = 1.5;
/// And so near one name stands for both.
const ONE_NAME: f64 = 12.0;

/// The transfers of each method, in the order in which the methods are first asked.
#[must_use]
pub fn by_method(circle: &CircleDiagram) -> Vec<Vec<&Transfer>> {
    let mut all: Vec<Vec<&Transfer>> = Vec::new();
    for transfer in &circle.transfers {
        match all.iter_mut().find(|same| same.iter().any(|t| t.method == transfer.method)) {
            Some(same) => same.push(transfer),
            None => all.push(vec![transfer]),
        }
    }
    all
}

/// The skeleton with the strokes of the transfers of one method.
#[must_use]
pub(super) fn draw(
    transfers: &[&Transfer],
    circle: &CircleDiagram,
    reach: &Reach<'_>,
    notation: &Notation<'_>,
) -> Group {
    let (construction, window) = (&*reach.construction, reach.window);
    let mut group = skeleton::draw_under(construction, notation, Arrows::Inputs, None, |_, _| {
        let strokes = strokes(transfers);
        let mut overlay = Overlay { ink: Group::new("strokes"), ..Overlay::default() };
        for stroke in &strokes {
            draw_stroke(stroke, window, notation, &mut overlay);
            name_turning(stroke, window, (circle, construction), notation, &mut overlay);
        }
        centres(transfers, circle, window, notation, &mut overlay);
        overlay.within = Some(reach.paper(notation));
        overlay
    });
    let unit = notation.unit(Dimension::Velocity);
    group.class = "transfer".to_owned();
    match transfers.first() {
        Some(first) => group.data("velocity-scale", format!("{}", first.si_per_mm / unit.si)),
        None => group,
    }
}

/// All strokes, each once: transfers along one chain begin alike.
pub(super) fn strokes(transfers: &[&Transfer]) -> Vec<TransferInk> {
    let mut all: Vec<TransferInk> = Vec::new();
    for stroke in transfers.iter().flat_map(|t| &t.ink) {
        if !all.contains(stroke) {
            all.push(*stroke);
        }
    }
    all
}

/// The ends of a stroke on the page.
pub(super) fn ends(stroke: &TransferInk) -> (Point, Point) {
    let (from, to) = match stroke {
        TransferInk::LineOfCentres { from, to }
        | TransferInk::Radius { from, to }
        | TransferInk::Gauge { from, to, .. }
        | TransferInk::Upright { from, to }
        | TransferInk::Parallel { from, to, .. }
        | TransferInk::ToPole { from, to }
        | TransferInk::Arc { from, to, .. }
        | TransferInk::Velocity { at: from, tip: to, .. }
        | TransferInk::Turned { at: from, tip: to, .. }
        | TransferInk::Difference { from, to, .. } => (from, to),
    };
    (page(*from), page(*to))
}

/// The skeleton's ink and its arrows, with what is needed, and as many ends of other strokes as find room: a line ends at a
/// point that is on the sheet. Centres are on the paper of their own figure; an arrow at one that is not on this is not drawn.
pub(super) fn window(transfers: &[&Transfer], skeleton: Rect, notation: &Notation<'_>) -> Window {
    let strokes = strokes(transfers);
    let about = |(from, to): (Point, Point)| {
        [from, to].map(|at| Rect::from_center_size(at, (2.0 * BLANK, 2.0 * BLANK)))
    };
    let is_arrow = |stroke: &&TransferInk| {
        matches!(
            stroke,
            TransferInk::Velocity { .. } | TransferInk::Turned { .. } | TransferInk::Difference { .. }
        )
    };
    let (at_centres, at_points): (Vec<_>, Vec<_>) =
        strokes.iter().filter(is_arrow).partition(|stroke| stands_at_centre(stroke));
    let at_points = at_points.into_iter().map(ends).flat_map(about);
    let mut start = at_points.fold(skeleton.inflate(BORDER, BORDER), |all, own| all.union(own));
    let most = room(notation);
    for [foot, tip] in at_centres.into_iter().map(ends).map(about) {
        let grown = start.union(foot);
        if grown.width() <= most.0.max(start.width()) && grown.height() <= most.1.max(start.height()) {
            start = grown.union(tip);
        }
    }
    // Beside the skeleton such an arrow is seen, if need be at a scale of the figure's own.
    let far = FAR * skeleton.width().max(skeleton.height());
    let beside = strokes.iter().filter(|stroke| stands_at_centre(stroke)).map(ends);
    let beside = beside.map(|(foot, _)| foot).filter(|foot| foot.distance(skeleton.center()) <= far);
    let needed: Vec<Point> = needed(transfers).into_iter().map(page).chain(beside).collect();
    let ends = strokes.iter().filter(|stroke| !stands_at_centre(stroke)).map(ends);
    window_over(
        start,
        &needed,
        ends.flat_map(|(a, b)| [a, b]).collect(),
        super::scale::stretch(notation.scene),
    )
}

/// Whether an arrow stands where no point of the mechanism is, but a centre.
fn stands_at_centre(stroke: &TransferInk) -> bool {
    matches!(stroke, TransferInk::Velocity { of: Spot::Centre(_), .. })
}

/// How large the part of the plane is that such a figure may show.
pub(super) fn room(notation: &Notation<'_>) -> (f64, f64) {
    let (wide, high) = super::scale::stretch(notation.scene);
    (LARGEST.0 * wide, LARGEST.1 * high)
}

/// Whether what it shows of the plane besides such a skeleton is no more than that.
pub(super) fn fits(window: Rect, skeleton: Rect, notation: &Notation<'_>) -> bool {
    let (wide, high) = room(notation);
    let bare = skeleton.inflate(BORDER, BORDER);
    window.width() <= wide.max(bare.width()) && window.height() <= high.max(bare.height())
}

/// What such a figure shows of the plane: what is needed, then other ends of strokes, on the part of the paper that a figure
/// usually has, which is so much more than that of upright A4.
pub(super) fn window_over(
    start: Rect,
    needed: &[Point],
    ends: Vec<Point>,
    (wide, high): (f64, f64),
) -> Window {
    let most = (LARGEST.0 * wide, LARGEST.1 * high);
    let with_needed = taking_in(start, needed.to_vec(), start.center(), BLANK, most);
    Window::over(taking_in(with_needed, ends, start.center(), BLANK, most), needed)
}

/// Without what nobody could follow the figure: where a point comes to lie that is turned about a pole.
pub(super) fn needed(transfers: &[&Transfer]) -> Vec<Mm2> {
    let turned = |ink: TransferInk| match ink {
        TransferInk::Arc { from, to, .. } => vec![from, to],
        _ => Vec::new(),
    };
    strokes(transfers).into_iter().flat_map(turned).collect()
}

/// The distances from poles that an act uses: of which link, to where, mm on paper.
fn measures(act: &TransferAct) -> Vec<(LinkId, Spot, f64)> {
    match *act {
        TransferAct::Ratio { input, link, mm, .. } => {
            let common = Spot::Centre(chord(input, link));
            vec![(input, common, mm[0]), (link, common, mm[1])]
        }
        TransferAct::CommonSpeed { links: [i, k], of, mm, .. } => {
            vec![(of, Spot::Centre(chord(i, k)), mm)]
        }
        TransferAct::AboutPole { link, point, mm, .. } => vec![(link, Spot::Point(point), mm)],
        TransferAct::Omega { link, spot, mm, .. } => vec![(link, spot, mm)],
        TransferAct::Translation { .. }
        | TransferAct::Difference { .. }
        | TransferAct::Gauge { .. }
        | TransferAct::Parallel { .. }
        | TransferAct::OmegaByParallel { .. } => Vec::new(),
    }
}

fn draw_stroke(stroke: &TransferInk, window: Rect, notation: &Notation<'_>, overlay: &mut Overlay) {
    let (from, to) = ends(stroke);
    let (class, pen) = match stroke {
        TransferInk::LineOfCentres { .. } => ("line-of-centres", Pen::solid(FINE)),
        TransferInk::Radius { .. } => ("radius", Pen::solid(FINE)),
        TransferInk::Gauge { .. } => ("gauge-line", Pen::solid(FINE)),
        TransferInk::Upright { .. } => ("upright", Pen::solid(THIN)),
        TransferInk::Parallel { .. } => ("parallel", Pen::solid(FINE)),
        TransferInk::ToPole { .. } => ("to-pole", Pen::solid(FINE)),
        TransferInk::Arc { centre, .. } => {
            arc(page(*centre), from, to, window, overlay);
            return;
        }
        // Of one that stands beyond the border its lines tell where.
        TransferInk::Velocity { .. } if !window.contains(from) => return,
        TransferInk::Velocity { of, .. } => {
            velocity(from, to, (spot_velocity(*of, notation), &spot_name(*of, notation)), overlay);
            return;
        }
        TransferInk::Difference { of, .. } => {
            let name = notation.quantity_name(*of);
            velocity(from, to, (notation.symbol(*of, false), &name), overlay);
            return;
        }
        TransferInk::Turned { of, .. } => {
            let mut own = Group::new("turned").data("point", notation.point_name(*of));
            if from.distance(to) > SHORTEST {
                let d = (to - from).normalize();
                let shaft = Shape::Line(from, to - d * (HEAD * 0.8));
                own.mark(Mark::stroke(shaft, Pen { width: THIN, dash: Dash::Dashed }).precise());
                own.mark(head(to, d, HEAD));
            }
            overlay.ink.group(own);
            let primed = notation.point(*of).up("′");
            let request = leader(primed, to, 0.6, "label");
            // A pin between two links is turned once, but for rounding.
            let is_there = |other: &Request| {
                let near = matches!(other.sites.first(), Some(Site::Around { at, .. }) if at.distance(to) < TOGETHER);
                near && other.text == request.text
            };
            if !overlay.labels.iter().any(is_there) {
                overlay.labels.push(request);
            }
            return;
        }
    };
    let mut own = Group::new(class);
    let mut line = |from: Point, to: Point| {
        let Some((t0, t1)) = clip(from, to, window) else { return };
        let (a, b) = (from.lerp(to, t0), from.lerp(to, t1));
        own.mark(Mark::stroke(Shape::Line(a, b), pen).class("ray").precise());
        // What runs off the sheet ends with an arrow at the border.
        if t1 < 1.0 && b.distance(a) > HEAD {
            own.mark(head(b, (to - from).normalize(), HEAD));
        }
        if t0 > 0.0 && b.distance(a) > HEAD {
            own.mark(head(a, (from - to).normalize(), HEAD));
        }
    };
    line(from, to);
    // The line on which the arrows stand whose tips the gauge line joins.
    if let TransferInk::Gauge { foot, .. } = stroke {
        line(from, page(*foot));
    }
    overlay.ink.group(own);
}

/// The pole that stands here.
fn pole_at(circle: &CircleDiagram, at: Mm2) -> Option<[LinkId; 2]> {
    let here = |centre: &&Centre| match centre.place {
        CentrePlace::At(place) => page(place).distance(page(at)) < TOGETHER,
        CentrePlace::Toward(_) => false,
    };
    let poles = circle.centres.iter().filter(|centre| centre.links[0] == LinkId::FRAME);
    poles.clone().find(here).map(|centre| centre.links)
}

/// Names what a gauge line needs: its pole where that lies beyond the border, the radius of an arc, and the point in the
/// place to which it was turned.
fn name_turning(
    stroke: &TransferInk,
    window: Rect,
    (circle, construction): (&CircleDiagram, &Construction),
    notation: &Notation<'_>,
    overlay: &mut Overlay,
) {
    match *stroke {
        TransferInk::Gauge { from, to, .. } => {
            let Some(pole) = pole_at(circle, from) else { return };
            let (at, end) = (page(from), page(to));
            // A pole within is named with the other centres.
            let Some((t0, _)) = clip(at, end, window).filter(|(t0, _)| *t0 > 0.0) else { return };
            let border = at.lerp(end, t0);
            let metres = at.distance(border) * construction.space.metres_per_mm;
            let text = super::centres::further(name(pole, notation), metres, notation);
            let request = leader(text, border, 0.6, "label centre-name");
            if !overlay.labels.contains(&request) {
                overlay.labels.push(request);
            }
        }
        TransferInk::LineOfCentres { from, to } | TransferInk::Radius { from, to } => {
            for (end, other) in [(from, to), (to, from)] {
                let (at, inside) = (page(end), page(other));
                let Some((_, t1)) = clip(inside, at, window).filter(|_| !window.contains(at)) else {
                    continue;
                };
                let here = |centre: &&Centre| matches!(centre.place, CentrePlace::At(own) if page(own).distance(at) < TOGETHER);
                let Some(centre) = circle.centres.iter().find(here) else { continue };
                let border = inside.lerp(at, t1);
                let metres = at.distance(border) * construction.space.metres_per_mm;
                let text = super::centres::further(name(centre.links, notation), metres, notation);
                let request = leader(text, border, 0.6, "label centre-name");
                // Two lines that leave the paper side by side have one name there.
                let told = |other: &Request| {
                    let near = matches!(other.sites.first(), Some(Site::Around { at, .. }) if at.distance(border) < ONE_NAME);
                    near && other.text == request.text
                };
                if !overlay.labels.iter().any(told) {
                    overlay.labels.push(request);
                }
            }
        }
        TransferInk::Arc { centre, from, to } => {
            let places = &construction.space.places;
            let here = |place: &Option<Mm2>| place.is_some_and(|p| page(p).distance(page(from)) < TOGETHER);
            let Some(point) = places.iter().position(here).map(PointId) else { return };
            if !window.contains(page(to)) || page(from).distance(page(to)) < TOGETHER {
                return;
            }
            let turned = Rich::upright("(").then(&notation.point(point)).up(")");
            overlay.labels.push(leader(turned, page(to), 0.6, "label"));
            if let Some(pole) = pole_at(circle, centre) {
                let [c, a, b] = [centre, from, to].map(page);
                let angle = |p: Point| libm::atan2(c.y - p.y, p.x - c.x);
                let sweep = libm::remainder(angle(b) - angle(a), std::f64::consts::TAU);
                let middle = on_circle(c, a.distance(c), angle(a) + sweep / 2.0);
                if window.contains(middle) {
                    let radius = distance(pole, notation.point_name(point), notation);
                    overlay.labels.push(leader(radius, middle, 0.4, "label"));
                }
            }
        }
        _ => {}
    }
}

fn velocity(from: Point, to: Point, (symbol, of): (Rich, &str), overlay: &mut Overlay) {
    let mut own = Group::new("velocity vector").data("of", of);
    if from.distance(to) < SHORTEST {
        own.mark(dot(from, 0.6));
        overlay.labels.push(leader(symbol.up("\u{a0}≈\u{a0}0"), from, 1.3, "label vector-name"));
    } else {
        arrow(&mut own, from, to, THICK);
        let mut request = Request::new(symbol, SMALL, Site::Along { from, to }, "label vector-name");
        let tip = Site::Around { at: to, radius: 0.6, toward: None };
        request = request.or(tip);
        request.leader = true;
        overlay.labels.push(request);
    }
    overlay.ink.group(own);
}

/// The arc from a point to where it comes to lie, the shorter way round.
fn arc(centre: Point, from: Point, to: Point, window: Rect, overlay: &mut Overlay) {
    let angle = |p: Point| libm::atan2(centre.y - p.y, p.x - centre.x);
    let radius = from.distance(centre);
    let sweep = libm::remainder(angle(to) - angle(from), std::f64::consts::TAU);
    let middle = on_circle(centre, radius, angle(from) + sweep / 2.0);
    let mut own = Group::new("arc");
    if [from, to, middle].iter().all(|p| window.contains(*p)) {
        let shape = Shape::Arc { centre, radius, start: angle(from), sweep };
        own.mark(Mark::stroke(shape, Pen { width: FINE, dash: Dash::Dashed }).class("arc"));
    }
    overlay.ink.group(own);
}

fn leader(text: Rich, at: Point, radius: f64, class: &'static str) -> Request {
    let mut request = Request::new(text, SMALL, Site::Around { at, radius, toward: None }, class);
    request.leader = true;
    request
}

/// All acts by which velocities are carried over: those of the figures, and those of steps that feed a diagram.
pub(super) fn acts<'a>(
    circle: &'a CircleDiagram,
    construction: &'a Construction,
) -> impl Iterator<Item = &'a TransferAct> {
    let fed = construction.steps.iter().flat_map(|step| &step.acts).filter_map(|act| match act {
        Act::ByCentres(part) => Some(part),
        _ => None,
    });
    circle.transfers.iter().flat_map(|transfer| &transfer.acts).chain(fed)
}

/// The centres by which velocities are carried over.
pub(super) fn used<'a>(acts: impl Iterator<Item = &'a TransferAct>) -> Vec<[LinkId; 2]> {
    let mut used: Vec<[LinkId; 2]> = Vec::new();
    let mut take = |links: &[LinkId]| {
        for &link in links {
            used.push(chord(LinkId::FRAME, link));
        }
        if let [i, j] = *links {
            used.push(chord(i, j));
        }
    };
    for act in acts {
        match act {
            TransferAct::Ratio { input, link, .. } => take(&[*input, *link]),
            TransferAct::CommonSpeed { links, .. } => take(links),
            TransferAct::AboutPole { link, .. }
            | TransferAct::Translation { link, .. }
            | TransferAct::Parallel { link, .. }
            | TransferAct::Omega { link, .. }
            | TransferAct::OmegaByParallel { link, .. } => take(&[*link]),
            TransferAct::Difference { .. } => {}
            TransferAct::Gauge { from: Spot::Centre(links), .. } => take(links),
            TransferAct::Gauge { .. } => {}
        }
    }
    used
}

/// The poles from which gauge lines are drawn.
pub(super) fn poles_of_gauges<'a>(
    transfers: &'a [&Transfer],
    circle: &'a CircleDiagram,
) -> impl Iterator<Item = [LinkId; 2]> + 'a {
    transfers.iter().flat_map(|t| &t.ink).filter_map(|ink| match ink {
        TransferInk::Gauge { from: pole, .. } | TransferInk::Arc { centre: pole, .. } => {
            pole_at(circle, *pole)
        }
        _ => None,
    })
}

/// The centres that the transfer uses, by name; those of pins are marked by the pins.
fn centres(
    transfers: &[&Transfer],
    circle: &CircleDiagram,
    window: Rect,
    notation: &Notation<'_>,
    overlay: &mut Overlay,
) {
    let used = used(transfers.iter().flat_map(|transfer| &transfer.acts));
    let poles = poles_of_gauges(transfers, circle);
    let mut used: Vec<[LinkId; 2]> = used.into_iter().chain(poles).collect();
    used.sort();
    used.dedup();
    let mut group = Group::new("centre-points");
    let mut crowds: Vec<(Point, Vec<[LinkId; 2]>)> = Vec::new();
    for links in used {
        let Some(CentrePlace::At(at)) = circle.centre(links).map(|c| c.place) else { continue };
        let at = page(at);
        if !window.contains(at) {
            continue;
        }
        match crowds.iter_mut().find(|(p, _)| p.distance(at) < TOGETHER) {
            Some((_, crowd)) => crowd.push(links),
            None => crowds.push((at, vec![links])),
        }
    }
    for (at, crowd) in crowds {
        let names: Vec<String> = crowd.iter().map(|c| centre_name(*c, notation)).collect();
        let mut own = Group::new("centre").data("centre", names.join(" "));
        own.mark(Mark::area(Shape::Circle { centre: at, radius: 0.6 }, Tone::Ink));
        group.group(own);
        let texts: Vec<Rich> = crowd.iter().map(|c| name(*c, notation)).collect();
        let text = Rich::join(&texts, &Rich::upright(","));
        overlay.labels.push(leader(text, at, 1.5, "label centre-name"));
    }
    overlay.ink.group(group);
}

fn spot_name(spot: Spot, notation: &Notation<'_>) -> String {
    match spot {
        Spot::Point(p) => notation.point_name(p).to_owned(),
        Spot::Centre(links) => centre_name(links, notation),
        Spot::Under(p, link) => {
            format!("{}{}", notation.point_name(p), notation.number_under(p, link))
        }
    }
}

/// The velocity of a spot; that of a centre is no quantity of the scene.
fn velocity_of(spot: Spot) -> Option<Quantity> {
    match spot {
        Spot::Point(p) => Some(Quantity::Velocity(p)),
        Spot::Under(p, link) => Some(Quantity::CoincidentVelocity(p, link)),
        Spot::Centre(_) => None,
    }
}

/// V_B, V₂₄.
fn spot_velocity(spot: Spot, notation: &Notation<'_>) -> Rich {
    match velocity_of(spot) {
        Some(quantity) => notation.symbol(quantity, false),
        None => Rich::italic("V").sub(&spot_name(spot, notation)),
    }
}

/// The name of an arrow, and the quantity that it is; other strokes have none.
pub(super) fn name_of_arrow(stroke: &TransferInk, notation: &Notation<'_>) -> (Rich, Option<Quantity>) {
    match *stroke {
        TransferInk::Velocity { of, .. } => (spot_velocity(of, notation), velocity_of(of)),
        TransferInk::Difference { of, .. } => (notation.symbol(of, false), Some(of)),
        _ => (Rich::default(), None),
    }
}

/// (14–24): the distance of a point from a pole.
fn distance(pole: [LinkId; 2], to: &str, notation: &Notation<'_>) -> Rich {
    let pole = centre_name(pole, notation);
    let strip = |s: &str| s.trim_matches(|c| c == '(' || c == ')').to_owned();
    Rich::upright(format!("({}–{})", strip(&pole), strip(to)))
}

/// The title of transfers by one method: ω₄, V_D by the direct method.
#[must_use]
pub fn title(transfers: &[&Transfer], notation: &Notation<'_>) -> Rich {
    let asked = |t: &&Transfer| notation.mechanism().asked.get(t.asked);
    let symbols: Vec<Rich> =
        transfers.iter().filter_map(asked).map(|asked| notation.symbol(asked.quantity, false)).collect();
    let Some(first) = transfers.first() else { return Rich::default() };
    let symbols = Rich::join(&symbols, &Rich::upright(", "));
    Rich::fill(method(first.method, notation), &[("quantity", symbols)])
}

fn method(method: Method, notation: &Notation<'_>) -> &'static str {
    match method {
        Method::LineOfCentres => notation.words.by_line_of_centres,
        Method::LinkToLink => notation.words.by_link_to_link,
        Method::GaugeLine => notation.words.by_gauge_line,
        Method::Centres
        | Method::Polygon
        | Method::Klein
        | Method::TwoMasses { .. }
        | Method::Lever
        | Method::ThreeForce
        | Method::Components => notation.words.by_direct_method,
    }
}

/// The steps of all transfers in words, method by method; what an earlier transfer of the same method has told is not
/// told again.
#[must_use]
pub fn items(
    circle: &CircleDiagram,
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Vec<Vec<Item>> {
    let mut every = Vec::new();
    for index in 0..by_method(circle).len() {
        let Some(reach) = Reach::of_transfer(index, construction, notation) else { continue };
        let Some(centres) = Reach::of_centres(construction, notation) else { continue };
        let shown = reach.construction.circle.as_ref().map(by_method).unwrap_or_default();
        let Some(same) = shown.into_iter().nth(index) else { continue };
        let mut all = vec![Item::Head(title(&same, notation).bolder())];
        let Some(si_per_mm) = same.first().map(|first| first.si_per_mm) else { continue };
        // Each method has readings of its own.
        let derived = |act: &Act| matches!(act, Act::ByCentres(_));
        let fed = construction.steps.iter().flat_map(|step| &step.acts).any(derived);
        let own = figures.borrow().of_inputs(Apart::Transfer(index), notation);
        let own = if fed { own.with_driven_points(&figures.borrow(), notation) } else { own };
        let own = RefCell::new(own);
        // What the steps have derived by the same method stands as they have printed it.
        let shared = fed && same.iter().all(|transfer| transfer.method == Method::Centres);
        let figures_here = if shared { figures } else { &own };
        let teller = Teller { notation, reach: &reach, centres: &centres, si_per_mm, figures: figures_here };
        let mut told: Vec<&TransferAct> = Vec::new();
        for act in same.iter().flat_map(|t| &t.acts) {
            if !told.contains(&act) {
                told.push(act);
                all.extend(teller.measured(act).into_iter().map(Item::Sentence));
                all.extend(teller.gauge_of_rate(act, &same).map(Item::Sentence));
                all.push(Item::Sentence(teller.sentence(act)));
            }
        }
        let asked = same.iter().map(|transfer| &notation.mechanism().asked[transfer.asked]);
        for asked in asked {
            let key = Key::of(asked.quantity, notation);
            let print = figures_here.borrow().print_of(key).cloned();
            if let Some(print) = print {
                figures.borrow_mut().keep_result(asked.method, key, print);
            }
        }
        figures.borrow_mut().keep_apart(Apart::Transfer(index), &own.borrow(), notation);
        every.push(all);
    }
    every
}

/// The lines of a part by which a velocity is found that a diagram takes up: what it measures, and what it comes to.
pub(super) fn lines(
    part: &TransferAct,
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Vec<Rich> {
    let Some(diagram) = construction.diagram(DiagramKind::Velocity) else { return Vec::new() };
    // It is measured where the centres are drawn.
    let Some(reach) = Reach::of_centres(construction, notation) else { return Vec::new() };
    let by = construction.space.metres_per_mm / reach.construction.space.metres_per_mm;
    let part = &part.with_lengths_by(by);
    let si_per_mm = diagram.si_per_mm;
    let teller = Teller { notation, reach: &reach, centres: &reach, si_per_mm, figures };
    teller.measured(part).into_iter().chain([teller.sentence(part)]).collect()
}

struct Teller<'a> {
    notation: &'a Notation<'a>,
    /// The figure that is drawn of it.
    reach: &'a Reach<'a>,
    /// The figure of instant centres, on which what is beyond the other one is measured.
    centres: &'a Reach<'a>,
    /// Of the velocities on the skeleton.
    si_per_mm: f64,
    /// How each number is printed.
    figures: &'a RefCell<Figures>,
}

impl Teller<'_> {
    fn metres_per_mm(&self) -> f64 {
        self.reach.construction.space.metres_per_mm
    }

    fn omega(&self, link: LinkId) -> Rich {
        self.notation.symbol(Quantity::Omega(link), false)
    }

    /// Of a pole and of where a distance from it ends, the centre that is not on the paper of a figure; none where both are.
    fn beyond(&self, figure: &Reach<'_>, link: LinkId, spot: Spot) -> Option<[LinkId; 2]> {
        let pole = chord(LinkId::FRAME, link);
        let end = match spot {
            Spot::Centre(links) => Some(links),
            Spot::Point(_) | Spot::Under(..) => None,
        };
        end.into_iter().chain([pole]).find(|links| figure.lies_beyond(*links))
    }

    /// That the slope of a gauge line is the rate, where the method is that of gauge lines.
    fn gauge_of_rate(&self, act: &TransferAct, same: &[&Transfer]) -> Option<Rich> {
        let TransferAct::Omega { link, spot, .. } = *act else { return None };
        same.iter().any(|transfer| transfer.method == Method::GaugeLine).then(|| {
            let parts = [
                ("pole", name(chord(LinkId::FRAME, link), self.notation)),
                ("velocity", spot_velocity(spot, self.notation)),
                ("omega", self.omega(link)),
            ];
            Rich::fill(self.notation.words.transfer_gauge_omega, &parts)
        })
    }

    /// A rate as it is told, with its sense.
    fn turning(&self, told: &Rich, value: f64) -> Rich {
        let unit = self.notation.angular_unit(Order::Velocity);
        self.notation.with_sense(human::with_unit(told, &unit.symbol), value)
    }

    /// What the velocity of a place is called in the list of printed numbers.
    fn speed_of(&self, spot: Spot) -> Key {
        match spot {
            Spot::Point(p) => Key::of(Quantity::Velocity(p), self.notation),
            Spot::Under(p, link) => Key::of(Quantity::CoincidentVelocity(p, link), self.notation),
            Spot::Centre(links) => Key::AtCentre(links),
        }
    }

    /// A length read on paper, and the speed that it is by the scale.
    fn read(&self, key: Key, mm: f64, speed: f64) -> [Rich; 2] {
        let unit = self.notation.unit(Dimension::Velocity);
        let exact = speed.abs() / unit.si;
        let more = self.figures.borrow().more(key).min(1);
        let (mm, value, written) = human::reading_at(mm.abs(), self.si_per_mm / unit.si, exact, more);
        self.figures.borrow_mut().note(key, &value, (written, exact), &unit);
        [mm, human::with_unit(&value, &unit.symbol)]
    }

    /// The distance of a place from the pole of a link, measured on paper.
    fn radius<'u>(&self, link: LinkId, spot: Spot, mm: f64, unit: &'u Unit) -> (Key, f64, &'u Unit) {
        (Key::Radius(chord(LinkId::FRAME, link), spot), mm.abs() * self.metres_per_mm(), unit)
    }

    /// The parts of a line `V = ω · distance = … · … = …`.
    fn about(&self, link: LinkId, spot: Spot, [omega, mm, speed]: [f64; 3]) -> [(&'static str, Rich); 6] {
        let n = self.notation;
        let (w, v) = (n.angular_unit(Order::Velocity), n.unit(Dimension::Velocity));
        let unit = &n.scene.units.length;
        let factors = [(Key::Of(Quantity::Omega(link)), omega, &w), self.radius(link, spot, mm, unit)];
        let result = (self.speed_of(spot), speed, &v);
        // A point under a pin is as far as the pin.
        let end = match spot {
            Spot::Under(point, _) => spot_name(Spot::Point(point), n),
            Spot::Point(_) | Spot::Centre(_) => spot_name(spot, n),
        };
        let ([rate, length], value) = self.figures.borrow_mut().line(factors, result, |[a, b]| a * b);
        [
            ("velocity", spot_velocity(spot, n)),
            ("omega", self.omega(link)),
            ("distance", distance(chord(LinkId::FRAME, link), &end, n)),
            ("omega_value", human::with_unit(&rate, &w.symbol)),
            ("length", human::with_unit(&length, &unit.symbol)),
            ("value", human::with_unit(&value, &v.symbol)),
        ]
    }

    /// The distances from poles that a line is about to use and nobody has measured yet.
    fn measured(&self, act: &TransferAct) -> Vec<Rich> {
        let all = measures(act).into_iter().map(|(link, spot, mm)| match spot {
            Spot::Point(point) if !self.notation.mechanism().link(link).points.contains(&point) => {
                (link, Spot::Under(point, link), mm)
            }
            _ => (link, spot, mm),
        });
        all.filter_map(|(link, spot, mm)| self.measured_radius(link, spot, mm)).collect()
    }

    fn measured_radius(&self, link: LinkId, spot: Spot, mm: f64) -> Option<Rich> {
        let unit = &self.notation.scene.units.length;
        let (key, metres, _) = self.radius(link, spot, mm, unit);
        if self.figures.borrow().has(key) {
            return None;
        }
        let own = self.beyond(self.reach, link, spot);
        // It is measured where it is on the paper.
        let figure = if own.is_some() { self.centres } else { self.reach };
        let metres_per_mm = figure.construction.space.metres_per_mm;
        let mm = mm * self.metres_per_mm() / metres_per_mm;
        let (factor, exact) = (metres_per_mm / unit.si, metres / unit.si);
        let more = self.figures.borrow().more(key).min(1);
        let told = human::reading_exactly(mm.abs(), factor, more);
        let (mm, value, written) = told.unwrap_or_else(|| human::reading_at(mm.abs(), factor, exact, more));
        self.figures.borrow_mut().note(key, &value, (written, exact), unit);
        let end = match spot {
            Spot::Under(point, _) => spot_name(Spot::Point(point), self.notation),
            Spot::Point(_) | Spot::Centre(_) => spot_name(spot, self.notation),
        };
        let length = distance(chord(LinkId::FRAME, link), &end, self.notation);
        let value = human::with_unit(&value, &unit.symbol);
        if let Some(centre) = own.and_then(|_| self.beyond(self.centres, link, spot)) {
            let parts = [("centre", name(centre, self.notation)), ("length", length), ("value", value)];
            return Some(Rich::fill(self.notation.words.distance_beyond, &parts));
        }
        Some(super::steps::measured_length(length, [mm, value], metres_per_mm, self.notation))
    }

    fn sentence(&self, act: &TransferAct) -> Rich {
        let words = self.notation.words;
        let pole = |link: LinkId| chord(LinkId::FRAME, link);
        let own = |p| self.notation.point(p);
        let velocity = |p| self.notation.symbol(Quantity::Velocity(p), false);
        let (w, v) = (self.notation.angular_unit(Order::Velocity), self.notation.unit(Dimension::Velocity));
        let unit = &self.notation.scene.units.length;
        let rate = |link: LinkId, omega: f64| (Key::Of(Quantity::Omega(link)), omega, &w);
        match *act {
            TransferAct::Ratio { input, link, mm, omegas } => {
                let common = Spot::Centre(chord(input, link));
                let [first, second] = [input, link]
                    .map(|l| distance(pole(l), &spot_name(common, self.notation), self.notation));
                let factors = [
                    rate(input, omegas[0]),
                    self.radius(input, common, mm[0], unit),
                    self.radius(link, common, mm[1], unit),
                ];
                let result = rate(link, omegas[1]);
                let ([known, a, b], value) =
                    self.figures.borrow_mut().line(factors, result, |[rate, a, b]| rate * a / b);
                let parts = [
                    ("omega", self.omega(link)),
                    ("known", self.omega(input)),
                    ("first", first),
                    ("second", second),
                    ("known_value", human::with_unit(&known, &w.symbol)),
                    ("a", human::with_unit(&a, &unit.symbol)),
                    ("b", human::with_unit(&b, &unit.symbol)),
                    ("value", self.turning(&value, omegas[1])),
                    ("common", name(chord(input, link), self.notation)),
                ];
                Rich::fill(words.transfer_ratio, &parts)
            }
            TransferAct::CommonSpeed { links: [i, k], of, mm, omega, speed } => {
                let common = chord(i, k);
                let links = [
                    ("centre", name(common, self.notation)),
                    ("one", Rich::upright(self.notation.number(i))),
                    ("other", Rich::upright(self.notation.number(k))),
                ];
                let line = self.about(of, Spot::Centre(common), [omega, mm, speed]);
                Rich::fill(words.transfer_common, &[&links[..], &line].concat())
            }
            TransferAct::AboutPole { link, point, mm, omega, speed } => {
                let own = self.notation.mechanism().link(link).points.contains(&point);
                let spot = if own { Spot::Point(point) } else { Spot::Under(point, link) };
                Rich::fill(words.transfer_about_pole, &self.about(link, spot, [omega, mm, speed]))
            }
            TransferAct::Translation { link, speed } => {
                // Mostly that of the centre of which was just told.
                let told = self.figures.borrow().same(speed, &v);
                let told = told.unwrap_or_else(|| human::number(speed / v.si));
                let value = human::with_unit(&told, &v.symbol);
                let parts = [("link", Rich::upright(self.notation.number(link))), ("value", value)];
                Rich::fill(words.transfer_translation, &parts)
            }
            TransferAct::Difference { quantity, of, against, mm, speed } => {
                let [mm, value] = self.read(Key::of(quantity, self.notation), mm, speed);
                let parts = [
                    ("relative", self.notation.symbol(quantity, false)),
                    ("of", spot_velocity(of, self.notation)),
                    ("against", spot_velocity(against, self.notation)),
                    ("mm", mm),
                    ("value", value),
                ];
                Rich::fill(words.transfer_difference, &parts)
            }
            TransferAct::Gauge { from, point, mm, speed } => {
                let [mm, value] = self.read(self.speed_of(Spot::Point(point)), mm, speed);
                let parts = [
                    ("known", spot_velocity(from, self.notation)),
                    ("point", own(point)),
                    ("velocity", velocity(point)),
                    ("mm", mm),
                    ("value", value),
                ];
                Rich::fill(words.transfer_gauge, &parts)
            }
            TransferAct::Parallel { link, from, to, flat, mm, speed } => {
                let template = if flat { words.transfer_parallel_flat } else { words.transfer_parallel };
                let [mm, value] = self.read(self.speed_of(Spot::Point(to)), mm, speed);
                let parts = [
                    ("from", own(from)),
                    ("to", own(to)),
                    ("pole", name(pole(link), self.notation)),
                    ("line", self.notation.length(from, to)),
                    ("velocity", velocity(to)),
                    ("known", velocity(from)),
                    ("mm", mm),
                    ("value", value),
                ];
                Rich::fill(template, &parts)
            }
            TransferAct::Omega { link, spot, mm, speed, omega } => {
                let factors = [(self.speed_of(spot), speed, &v), self.radius(link, spot, mm, unit)];
                let result = rate(link, omega);
                let ([speed, length], value) =
                    self.figures.borrow_mut().line(factors, result, |[v, l]| v / l);
                let parts = [
                    ("omega", self.omega(link)),
                    ("velocity", spot_velocity(spot, self.notation)),
                    ("distance", distance(pole(link), &spot_name(spot, self.notation), self.notation)),
                    ("speed", human::with_unit(&speed, &v.symbol)),
                    ("length", human::with_unit(&length, &unit.symbol)),
                    ("value", self.turning(&value, omega)),
                ];
                Rich::fill(words.transfer_omega, &parts)
            }
            TransferAct::OmegaByParallel { link, from, to, flat, mm, omega } => {
                // A′B′ may lie against AB: then both together are what the velocities differ by.
                let against = mm[0] < 0.0;
                let reckon = |[a, b]: [f64; 2]| {
                    let apart = if against { a + b } else { (a - b).abs() };
                    apart * self.si_per_mm / (b * self.metres_per_mm()) / w.si
                };
                let [a, b] = human::readings(mm.map(f64::abs), omega.abs() / w.si, reckon);
                let (key, omega_si, _) = rate(link, omega);
                let value = self.figures.borrow_mut().tell(key, omega_si, &w);
                let (v, unit) = (self.notation.unit(Dimension::Velocity), &self.notation.scene.units.length);
                let [apart] = human::readings([(mm[0] - mm[1]).abs()], omega.abs() / w.si, |[apart]| {
                    apart * self.si_per_mm / (mm[1].abs() * self.metres_per_mm()) / w.si
                });
                let quotient = apart.clone().up("\u{a0}×\u{a0}").then(&human::stated(self.si_per_mm / v.si));
                let length = human::quantity(mm[1].abs() * self.metres_per_mm(), unit);
                let quotient = quotient.up("\u{a0}/\u{a0}").then(&length);
                let parts = [
                    ("apart", apart),
                    ("quotient", quotient),
                    ("omega", self.omega(link)),
                    ("from", own(from)),
                    ("to", own(to)),
                    ("line", self.notation.length(from, to)),
                    ("pole", name(pole(link), self.notation)),
                    ("known", velocity(from)),
                    ("relative", self.notation.symbol(Quantity::RelativeVelocity(to, from), false)),
                    ("a", a),
                    ("b", b),
                    ("value", self.turning(&value, omega)),
                ];
                let template = match flat {
                    _ if self.notation.mechanism().is_fixed(to) => words.transfer_onto_fixed,
                    true => words.transfer_onto_parallel_flat,
                    false => words.transfer_onto_parallel,
                };
                let drawn = Rich::fill(template, &parts);
                let told = Rich::fill(words.transfer_omega_by_parallel[usize::from(against)], &parts);
                drawn.up(" ").then(&told)
            }
        }
    }
}
