//! Pairs that rub, enlarged: the friction circle with the line of the force that touches it, the guide with the force
//! that leans from its normal. The drawing itself uses the circles in their true size; only these figures enlarge them.

use kurbo::{Point, Vec2};

use super::figure::{Dash, Group, Mark, Pen, Shape};
use super::forces::symbol;
use super::human;
use super::ink::{FINE, LABEL, SMALL, THICK, THIN, arc_arrow, arrow, dot, page};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::rich::Rich;
use crate::graphical::construction::{About, Construction, ForceSheet, FreeBody, FrictionAxis, Touch};
use crate::mechanism::LinkId;
use crate::mechanism::Mechanism;
use crate::mechanism::force::{Action, Party, Through};
use crate::mechanism::friction::{RubbedBy, RubbingPair};

/// Radius of an enlarged friction circle, mm: so much at most, for a round scale.
const CIRCLE: f64 = 12.0;
/// Half the length of a line of force in an enlarged figure, mm.
const LINE: f64 = 24.0;
/// A circle of a smaller radius is not seen on a skeleton, mm.
const LEAST: f64 = 1.0;

/// The pairs that have a figure of their own, by their places among those that rub: all but bare drags.
pub(super) fn panels(sheet: &ForceSheet) -> impl Iterator<Item = usize> + '_ {
    let rubs = sheet.rubs.iter().enumerate();
    rubs.filter(|(_, touch)| !matches!(touch.rub.by, RubbedBy::Drag(_))).map(|(index, _)| index)
}

/// The name of the point at which a pair rubs.
pub(super) fn point<'m>(index: usize, sheet: &ForceSheet, mechanism: &'m Mechanism) -> Option<&'m str> {
    mechanism.rubbing_name(sheet.rubs.get(index)?.rub.pair)
}

/// The force that leans or touches, as it is asked for.
fn action(touch: &Touch, mechanism: &Mechanism) -> Action {
    let [on, by] = touch.between;
    match mechanism.rubbing_through(touch.rub.pair) {
        Through::Pin(pin) if mechanism.parties_at(pin).len() > 2 => match touch.rub.pair {
            RubbingPair::Slide(_) => Action::OnPin(by, pin),
            RubbingPair::Pin { .. } => Action::OfPin(pin, on),
        },
        _ => Action::Pair { by, on },
    }
}

fn name(touch: &Touch, notation: &Notation<'_>) -> Rich {
    let mechanism = notation.mechanism();
    let point = match touch.rub.pair {
        RubbingPair::Pin { pin, .. } => Some(pin),
        RubbingPair::Slide(slide) => mechanism.pin_of_slide(slide),
    };
    point.map(|point| notation.point(point)).unwrap_or_default()
}

pub(super) fn title(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Rich {
    let touch = sheet.rubs.get(index);
    // A pin in a block rubs at one place twice.
    if let Some(RubbingPair::Slide(slide)) = touch.map(|touch| touch.rub.pair) {
        let guide = ("guide", notation.named_guide(slide));
        return Rich::fill(notation.words.friction_guide_figure, &[guide]);
    }
    let at = touch.map(|touch| name(touch, notation)).unwrap_or_default();
    Rich::fill(notation.words.friction_figure, &[("point", at)])
}

/// Metres of a millimetre of an enlarged figure.
fn metres_per_mm(touch: &Touch) -> Option<f64> {
    match touch.rub.by {
        RubbedBy::Circle(radius) => {
            super::scale::choose_length(2.0 * radius, 2.0 * radius, (2.0 * CIRCLE, 2.0 * CIRCLE))
        }
        RubbedBy::Angle(_) | RubbedBy::Drag(_) => None,
    }
}

/// How much is enlarged, in the scene's units; nothing to tell of a guide.
pub(super) fn scale(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Option<Rich> {
    let touch = sheet.rubs.get(index)?;
    Some(match metres_per_mm(touch) {
        Some(metres) => notation.length_scale(metres),
        None => Rich::default(),
    })
}

/// The friction circles of a link, in their true size where that is seen.
pub(super) fn circles_on(
    group: &mut Group,
    link: LinkId,
    sheet: &ForceSheet,
    construction: &Construction,
    notation: &Notation<'_>,
) {
    for touch in sheet.rubs.iter().filter(|touch| touch.between.contains(&link)) {
        let RubbedBy::Circle(radius) = touch.rub.by else { continue };
        let per_mm = construction.space.metres_per_mm;
        let radius = radius / per_mm;
        if radius < LEAST {
            continue;
        }
        let centre = page(touch.at.map(|metres| metres / per_mm));
        let mut own = Group::new("friction-circle").data("link", notation.number(link));
        own.mark(
            Mark::stroke(Shape::Circle { centre, radius }, Pen { width: FINE, dash: Dash::Dashed }).precise(),
        );
        group.group(own);
    }
}

/// A pair that rubs.
pub(super) fn draw(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Option<Group> {
    let touch = sheet.rubs.get(index)?;
    let size = libm::hypot(touch.force[0], touch.force[1]);
    if size == 0.0 {
        return None;
    }
    let along = Vec2::new(touch.force[0] / size, -touch.force[1] / size);
    let mut group = Group::new("friction").data("point", point(index, sheet, notation.mechanism())?);
    let mut requests = Vec::new();
    let pin = Point::ORIGIN;
    let text = symbol(action(touch, notation.mechanism()), notation);
    match (touch.rub.by, touch.along) {
        (RubbedBy::Circle(circle), _) => {
            let per_mm = metres_per_mm(touch)?;
            let circle = circle / per_mm;
            let off = [0, 1].map(|axis| (touch.through[axis] - touch.at[axis]) / per_mm);
            // The foot of the line from the pin.
            let through = page(off).to_vec2();
            let foot = pin + (through - along * through.dot(along));
            let ring = Shape::Circle { centre: pin, radius: circle };
            group.mark(Mark::stroke(ring, Pen::solid(THIN)).class("friction-circle").precise());
            let radius = Shape::Line(pin, foot);
            group.mark(Mark::stroke(radius, Pen { width: FINE, dash: Dash::Dashed }).precise());
            let name_of_radius = Rich::italic("r").sub("f");
            let site = Site::Along { from: pin, to: foot };
            requests.push(Request::new(name_of_radius, SMALL, site, "label arm-name"));
            let mut own = Group::new("force applied");
            arrow(&mut own, foot - along * LINE, foot + along * LINE, THICK);
            group.group(own);
            let end = foot + along * LINE;
            let toward = Some(libm::atan2(-along.y, along.x));
            let site = Site::Around { at: end, radius: 0.8, toward };
            requests.push(Request::new(text, SMALL, site, "label force-name"));
            // How the link turns on its carrier.
            let (start, sweep) = if touch.rub.forward { (0.5, 2.2) } else { (2.6, -2.2) };
            let mut own = Group::new("rotation");
            arc_arrow(&mut own, pin, circle + 4.0, start, sweep, THIN);
            group.group(own);
            let [link, carrier] = touch.between.map(|link| notation.number(link));
            let omega = Rich::italic("ω").sub(&format!("{link}{carrier}"));
            let site = Site::Around { at: pin, radius: circle + 4.6, toward: Some(1.6) };
            requests.push(Request::new(omega, SMALL, site, "label rotation-name"));
        }
        (RubbedBy::Angle(angle), Some(guide)) => {
            let guide = Vec2::new(guide[0], -guide[1]);
            let left = Vec2::new(guide.y, -guide.x);
            let normal = if left.dot(along) < 0.0 { -left } else { left };
            let line = Shape::Line(pin - guide * LINE, pin + guide * LINE);
            group.mark(Mark::stroke(line, Pen::solid(THIN)).class("guide").precise());
            let line = Shape::Line(pin, pin + normal * LINE);
            group.mark(Mark::stroke(line, Pen { width: FINE, dash: Dash::Dashed }).precise());
            let mut own = Group::new("force applied");
            arrow(&mut own, pin, pin + along * LINE, THICK);
            group.group(own);
            let site = Site::Around {
                at: pin + along * LINE,
                radius: 0.8,
                toward: Some(libm::atan2(-along.y, along.x)),
            };
            requests.push(Request::new(text, SMALL, site, "label force-name"));
            let start = libm::atan2(-normal.y, normal.x);
            let lean = libm::atan2(-along.y, along.x) - start;
            let sweep = libm::remainder(lean, std::f64::consts::TAU);
            if sweep != 0.0 {
                let radius = LINE * 0.6;
                let arc = Shape::Arc { centre: pin, radius, start, sweep };
                group.mark(Mark::stroke(arc, Pen::solid(FINE)).class("angle"));
                let middle = start + sweep / 2.0;
                let (sin, cos) = libm::sincos(middle);
                let at = pin + Vec2::new(cos, -sin) * radius;
                let phi = Rich::italic("φ").up("\u{a0}=\u{a0}").then(&human::degrees(angle));
                let mut request = Request::new(
                    phi,
                    SMALL,
                    Site::Around { at, radius: 1.0, toward: Some(middle) },
                    "label angle-name",
                );
                request.leader = true;
                requests.push(request);
            }
            // Whither the rider slides.
            let sliding = if touch.rub.forward { guide } else { -guide };
            let from = pin - normal * 4.0 - sliding * 6.0;
            let mut own = Group::new("sliding");
            arrow(&mut own, from, from + sliding * 12.0, THIN);
            group.group(own);
        }
        (RubbedBy::Angle(_) | RubbedBy::Drag(_), _) => return None,
    }
    let mut own = Group::new("pin");
    own.mark(dot(pin, 0.7));
    group.group(own);
    let site = Site::Around { at: pin, radius: 1.2, toward: None };
    requests.push(Request::new(name(touch, notation), LABEL, site, "label point-name"));
    let names = place(&group, &requests, None);
    group.group(names);
    Some(group)
}

/// The pairs with figures whose force is drawn first on a body.
pub(super) fn before(body: usize, sheet: &ForceSheet) -> impl Iterator<Item = usize> + '_ {
    panels(sheet).filter(move |index| first_body(*index, sheet) == Some(body))
}

/// The pair with a figure that is told first.
pub(super) fn first(sheet: &ForceSheet) -> Option<usize> {
    (0..sheet.bodies.len()).find_map(|body| before(body, sheet).next())
}

/// The constant drags that act first on a body.
pub(super) fn drags_before(body: usize, sheet: &ForceSheet) -> impl Iterator<Item = usize> + '_ {
    let drags = (0..sheet.rubs.len()).filter(|index| matches!(sheet.rubs[*index].rub.by, RubbedBy::Drag(_)));
    drags.filter(move |index| first_body(*index, sheet) == Some(body))
}

/// The body at which the force of a pair that rubs is told: the first on which it acts. The line of a link between two
/// friction circles needs both, so the second circle is told with the first.
fn first_body(index: usize, sheet: &ForceSheet) -> Option<usize> {
    let touch = sheet.rubs.get(index)?;
    let of_axes = axes(sheet).filter(|(body, _)| touch.along.is_none() && touch.acts_on(body));
    of_axes.map(|(body, _)| told_at(body, sheet)).chain([acts_first(touch, sheet)]).flatten().min()
}

/// The first body on which the force of a pair that rubs acts.
fn acts_first(touch: &Touch, sheet: &ForceSheet) -> Option<usize> {
    let of_body = sheet.bodies.iter().position(|body| touch.acts_on(body));
    // Moments may be taken about where it touches before its body is in balance.
    let contact = |about: About| {
        matches!((about, touch.rub.pair),
        (About::Contact { pin, .. }, RubbingPair::Pin { pin: own, .. }) if pin == own)
    };
    let of_moments =
        sheet.moments.iter().filter(|moments| contact(moments.about)).map(|moments| moments.told);
    of_body.into_iter().chain(of_moments).min()
}

/// The links between two friction circles, with the tangent along which each pulls or pushes.
fn axes(sheet: &ForceSheet) -> impl Iterator<Item = (&FreeBody, FrictionAxis)> {
    sheet.bodies.iter().filter_map(|body| Some((body, sheet.friction_axis(body)?)))
}

/// The body at which the friction axis of a link is told: the first on which a force along it acts.
fn told_at(body: &FreeBody, sheet: &ForceSheet) -> Option<usize> {
    let circles = sheet.rubs.iter().filter(|touch| touch.along.is_none() && touch.acts_on(body));
    circles.filter_map(|touch| acts_first(touch, sheet)).min()
}

/// The friction axes that are told at a body, with their links.
pub(super) fn axes_told(
    index: usize,
    sheet: &ForceSheet,
) -> impl Iterator<Item = (LinkId, FrictionAxis)> + '_ {
    axes(sheet).filter_map(move |(body, axis)| match body.of {
        Party::Link(link) if told_at(body, sheet) == Some(index) => Some((link, axis)),
        _ => None,
    })
}

/// An angle of friction as finely as a circle is reckoned from it.
pub(super) fn fine_degrees(radians: f64) -> Rich {
    let text = human::fixed(radians.to_degrees(), 3);
    Rich::upright(text.trim_end_matches('0').trim_end_matches('.')).up("°")
}

/// The place of a pair that rubs, as an index: the pin, or the link and the pin that slides on it.
pub(super) fn place_name(touch: &Touch, notation: &Notation<'_>) -> String {
    let mechanism = notation.mechanism();
    match touch.rub.pair {
        RubbingPair::Pin { pin, .. } => notation.index(pin),
        RubbingPair::Slide(slide) => {
            let guide = notation.number(mechanism.slides[slide].guide.link);
            let point = mechanism.pin_of_slide(slide).map(|point| notation.index(point));
            point.map_or(guide.clone(), |point| format!("{guide}{point}"))
        }
    }
}

/// What a pair that rubs does to the line of its force.
pub(super) fn sentence(index: usize, sheet: &ForceSheet, notation: &Notation<'_>) -> Rich {
    let Some(touch) = sheet.rubs.get(index) else { return Rich::default() };
    let words = notation.words;
    let [link, carrier] = touch.between.map(|link| Rich::upright(notation.number(link)));
    let force = symbol(action(touch, notation.mechanism()), notation);
    let at = ("point", name(touch, notation));
    // What is zero leans nowhere.
    if touch.force == [0.0; 2] && !matches!(touch.rub.by, RubbedBy::Drag(_)) {
        return Rich::fill(words.friction_idle, &[at, ("force", force)]);
    }
    match touch.rub.by {
        RubbedBy::Circle(radius) => {
            let radius = human::quantity(radius, &notation.scene.units.length);
            let sense = Rich::upright(if touch.rub.forward { words.ccw } else { words.cw });
            let parts = [
                at,
                ("force", force),
                ("radius", radius),
                ("link", link),
                ("carrier", carrier),
                ("sense", sense),
            ];
            Rich::fill(words.friction_circle, &parts)
        }
        RubbedBy::Angle(angle) => {
            Rich::fill(words.friction_angle, &[at, ("force", force), ("angle", human::degrees(angle))])
        }
        RubbedBy::Drag(size) => {
            let size = human::quantity(size, &notation.scene.units.force);
            Rich::fill(words.friction_drag, &[at, ("force", size)])
        }
    }
}
