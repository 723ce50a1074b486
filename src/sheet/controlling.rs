//! The controlling-force diagram of a governor: M ω² r over the distance of the ball from the axis, with rays of constant
//! speed.

use std::f64::consts::{FRAC_PI_2, PI};

use kurbo::{Point, Vec2};

use super::compose::tight;
use super::figure::{Dash, Figure, Group, Mark, Pen, Shape};
use super::human;
use super::ink::{FINE, SMALL, THICK, THIN, arrow};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::panels::captioned;
use super::rich::Rich;
use super::words::Language;
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Quantity, Unit};
use crate::scene::Scene;
use crate::sweep::governor::{Governed, Part, Place, Stability};

/// Width and height of the plot, mm.
const PLOT: (f64, f64) = (110.0, 70.0);
/// Type size of the numbers at the axes.
const TICK: f64 = 2.6;
/// So many rays of constant speed at least.
const RAYS: f64 = 3.0;
/// Speeds are shown up to so many times the scene's own.
const USED: f64 = 1.75;
/// Round steps of axes and speeds.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// A round step, so that there are at least so many of them in a range.
fn step(range: f64, least: f64) -> f64 {
    let wanted = range / least;
    let power = libm::pow(10.0, libm::floor(libm::log10(wanted)));
    STEPS.iter().rev().map(|step| step * power).find(|step| *step <= wanted).unwrap_or(power)
}

/// Multiples of a step within a range.
fn multiples(step: f64, [from, to]: [f64; 2]) -> Vec<f64> {
    let first = libm::ceil(from / step - 1e-9);
    let count = libm::floor(to / step + 1e-9) - first;
    if !(0.0..=200.0).contains(&count) {
        return Vec::new();
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few")]
    (0..=count as u32).map(|k| (first + f64::from(k)) * step).collect()
}

/// The diagram as a figure; none where there is no equilibrium in the range.
#[must_use]
pub fn controlling_force(scene: &Scene, governed: &Governed, language: Language) -> Option<Figure> {
    let words = language.words();
    let notation = &Notation::new(scene, words);
    let governed = &as_far_as_it_is_used(governed);
    let last = governed.places.last()?;
    let (length, force) = (&scene.units.length, &scene.units.force);
    let speed = speed_unit(scene);
    let most = governed
        .places
        .iter()
        .flat_map(|place| place.rising_falling.map(|speed| governed.force(place, speed)))
        .fold(0.0, f64::max);
    if most <= 0.0 || last.radius <= 0.0 {
        return None;
    }
    let x = |radius: f64| radius / last.radius * PLOT.0;
    let y = |newtons: f64| -newtons / most * PLOT.1;
    let mut group = Group::new("controlling-force")
        .data("radius-per-mm", format!("{}", last.radius / PLOT.0 / length.si))
        .data("force-per-mm", format!("{}", most / PLOT.1 / force.si));
    let mut requests = Vec::new();
    rays(&mut group, &mut requests, governed, (&x, &y), &speed);
    axes(&mut group, &mut requests, governed, notation, (&x, &y), most);
    let curve = |of: &dyn Fn(&Place) -> f64| -> Vec<Point> {
        let at = |place: &Place| Point::new(x(place.radius), y(governed.force(place, of(place))));
        governed.places.iter().map(at).collect()
    };
    let mut curves = vec![("curve", curve(&|place| place.speed), Pen::solid(THICK * 0.8))];
    if governed.drags {
        let dashed = Pen { width: THIN, dash: Dash::Dashed };
        curves.push(("curve rising", curve(&|place| place.rising_falling[0]), dashed));
        curves.push(("curve falling", curve(&|place| place.rising_falling[1]), Pen::solid(THIN)));
    }
    for (class, points, pen) in curves {
        let mut own = Group::new(class);
        let end = points.last().copied();
        own.mark(Mark::stroke(Shape::Polyline(points), pen).precise());
        group.group(own);
        let share = match class {
            "curve rising" => Share::Rising,
            "curve falling" => Share::Falling,
            _ => continue,
        };
        let name = notation.symbol(Quantity::Force(Force::Spin, share), false);
        if let Some(at) = end {
            let site = Site::Around { at, radius: 1.0, toward: Some(0.0) };
            let mut request = Request::new(name, SMALL, site, "label curve-name");
            request.leader = true;
            requests.push(request);
        }
    }
    for part in &governed.parts {
        mark_part(&mut group, part, &x);
    }
    let names = place(&group, &requests, None);
    group.group(names);
    let mut caption = vec![Rich::bold(words.controlling_figure)];
    caption.extend(governed.parts.iter().map(|part| {
        let kind = match part.stability {
            Stability::Stable => words.stable,
            Stability::Isochronous => words.isochronous,
            Stability::Unstable => words.unstable,
        };
        let [from, to] = part.radii.map(|radius| human::quantity(radius, length));
        Rich::fill(kind, &[("from", from), ("to", to)])
    }));
    Some(tight(scene, captioned(group, &caption), words.controlling_figure, words))
}

/// The places at speeds that are not far from the scene's own: where arms are stretched speeds grow without end.
fn as_far_as_it_is_used(governed: &Governed) -> Governed {
    let away = |place: &Place| (place.at - governed.sweep.start).abs();
    let own = governed.places.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let most = own.map_or(f64::INFINITY, |own| USED * own.speed);
    let places = governed.places.iter().filter(|place| place.speed <= most).copied().collect();
    Governed { places, ..governed.clone() }
}

/// The unit in which the scene asks for its speed.
fn speed_unit(scene: &Scene) -> Unit {
    let asked = scene.mechanism.asked.iter();
    let of = asked.filter(|asked| matches!(asked.quantity, Quantity::Force(Force::Spin, _)));
    let unit = of.map(|asked| asked.unit.clone()).next();
    unit.unwrap_or_else(|| Unit { symbol: "rad/s".to_owned(), si: 1.0 })
}

/// Lines through the origin, on which the speed is one.
fn rays(
    group: &mut Group,
    requests: &mut Vec<Request>,
    governed: &Governed,
    (x, y): (&dyn Fn(f64) -> f64, &dyn Fn(f64) -> f64),
    unit: &Unit,
) {
    let speeds = || governed.places.iter().flat_map(|place| place.rising_falling);
    let range = [speeds().fold(f64::INFINITY, f64::min), speeds().fold(0.0, f64::max)].map(|s| s / unit.si);
    let step = step((range[1] - range[0]).max(0.1 * range[1]), RAYS);
    let Some(last) = governed.places.last() else { return };
    let all = governed.places.iter();
    let forces = all.flat_map(|place| place.rising_falling.map(|speed| governed.force(place, speed)));
    let top = forces.fold(0.0, f64::max);
    for speed in multiples(step, [range[0] - step, range[1] + step]).into_iter().filter(|speed| *speed > 0.0)
    {
        let si = speed * unit.si;
        let per_radius = governed.mass * si * si;
        let radius = last.radius.min(1.05 * top / per_radius);
        let end = Point::new(x(radius), y(per_radius * radius));
        let mut own = Group::new("ray").data("speed", format!("{speed}"));
        own.mark(Mark::stroke(Shape::Line(Point::ZERO, end), Pen::solid(FINE)).precise());
        group.group(own);
        let text = human::with_unit(&human::stated(speed), &unit.symbol);
        let site = Site::Around { at: end, radius: 0.8, toward: Some(0.4) };
        let mut request = Request::new(text, TICK, site, "label ray-name");
        request.leader = true;
        requests.push(request);
    }
}

/// The axes with round numbers in the scene's units.
fn axes(
    group: &mut Group,
    requests: &mut Vec<Request>,
    governed: &Governed,
    notation: &Notation<'_>,
    (x, y): (&dyn Fn(f64) -> f64, &dyn Fn(f64) -> f64),
    most: f64,
) {
    let units = &notation.scene.units;
    let farthest = governed.places.last().map_or(0.0, |place| place.radius);
    let [right, top] = [Point::new(PLOT.0 + 8.0, 0.0), Point::new(0.0, -PLOT.1 - 8.0)];
    arrow(group, Point::ZERO, right, THIN);
    arrow(group, Point::ZERO, top, THIN);
    let mut tick = |at: Point, toward: Vec2, value: f64, angle: f64| {
        let line = Shape::Line(at - toward, at + toward);
        group.mark(Mark::stroke(line, Pen::solid(FINE)).class("tick"));
        let site = Site::Around { at, radius: 1.0, toward: Some(angle) };
        let mut request = Request::new(human::stated(value), TICK, site, "tick");
        request.optional = true;
        requests.push(request);
    };
    for value in multiples(step(farthest / units.length.si, 4.0), [0.0, farthest / units.length.si]) {
        tick(Point::new(x(value * units.length.si), 0.0), Vec2::new(0.0, 0.6), value, FRAC_PI_2);
    }
    for value in multiples(step(most / units.force.si, 4.0), [0.0, most / units.force.si]) {
        tick(Point::new(0.0, y(value * units.force.si)), Vec2::new(0.6, 0.0), value, PI);
    }
    let link = notation.mechanism().forces.masses.iter().find(|mass| mass.centre == governed.ball);
    let force = link.map_or_else(
        || Rich::italic("F").sub("c"),
        |mass| {
            notation
                .symbol(Quantity::Force(Force::Vector(Action::Centrifugal(mass.link)), Share::Total), false)
        },
    );
    for (name, unit, at, toward) in
        [(Rich::italic("r"), &units.length, right, 0.0), (force, &units.force, top, 0.0)]
    {
        let unit = Rich::upright(human::pretty(&unit.symbol));
        let text = Rich::fill(notation.words.in_unit, &[("symbol", name), ("unit", unit)]);
        let site = Site::Around { at, radius: 1.0, toward: Some(toward) };
        let mut request = Request::new(text, SMALL, site, "label axis-name");
        request.leader = true;
        requests.push(request);
    }
}

/// A part of the range below the axis of radii: a double line where it is stable, a broken one where it is not.
fn mark_part(group: &mut Group, part: &Part, x: &dyn Fn(f64) -> f64) {
    let [from, to] = part.radii.map(|radius| Point::new(x(radius), 6.0));
    let mut own = Group::new("part").data("stability", part.stability.name());
    let dash = if part.stability == Stability::Stable { Dash::Solid } else { Dash::Dashed };
    own.mark(Mark::stroke(Shape::Line(from, to), Pen { width: THICK, dash }));
    for end in [from, to] {
        let tick = Shape::Line(end - Vec2::new(0.0, 1.0), end + Vec2::new(0.0, 1.0));
        own.mark(Mark::stroke(tick, Pen::solid(FINE)));
    }
    group.group(own);
}
