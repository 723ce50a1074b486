//! The turning-moment diagram as ink: the curves over the angle with the areas between them, and the levels of energy.

use std::cell::RefCell;

use kurbo::{Point, Vec2};

use super::cycle_lines::{Computed, given_ratio, own_inertia};
use super::figure::{Dash, Group, Mark, Pen, Shape};
use super::human;
use super::ink::{FINE, SMALL, THICK, THIN, arrow, dot};
use super::labels::{Request, Site, place};
use super::notation::Notation;
use super::printed::Figures;
use super::rich::Rich;
use super::steps::Item;
use super::waves::Waves;
use super::words::Words;
use crate::graphical::cycle::CycleSheet;
use crate::mechanism::curve::Curve;
use crate::mechanism::cycle::{Copies, Course, Cycle, CycleQuantity, RotatingInertia, Sides};
use crate::mechanism::quantity::{Order, Quantity, Unit};
use crate::mechanism::spin::SpinSpeed;

/// Width and height of the plot, mm.
const PLOT: (f64, f64) = (120.0, 56.0);
/// Height of the levels, mm.
const LEVELS: f64 = 40.0;
/// Type size of the numbers at the axes.
const TICK: f64 = 2.6;
/// Between two strokes of hatching, mm.
const HATCH: f64 = 1.6;
/// An area narrower than this has no room for its number.
const NARROW: f64 = 4.0;
/// Steps of the scales.
const STEPS: [f64; 4] = [1.0, 2.0, 2.5, 5.0];

/// A drawing of the cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum CyclePanel {
    /// The curves, the mean line, the areas.
    TurningMoment,
    /// The levels of energy.
    Energy,
}

/// The symbol of a number of the diagram.
pub(super) fn symbol(notation: &Notation<'_>, of: CycleQuantity) -> Rich {
    let it = |letter: &str, sub: &str| Rich::italic(letter).sub(sub);
    match of {
        CycleQuantity::Mean => it("T", "m"),
        CycleQuantity::Work => Rich::italic("E"),
        // A load has the letter already: the mean power, as T_m is the mean torque.
        CycleQuantity::Power if notation.mechanism().forces.loads.iter().any(|load| load.name == "P") => {
            it("P", "m")
        }
        CycleQuantity::Power => Rich::italic("P"),
        CycleQuantity::Highest => it("E", "max"),
        CycleQuantity::Lowest => it("E", "min"),
        CycleQuantity::Fluctuation => it("E", "f"),
        CycleQuantity::OfEnergy => it("K", "e"),
        CycleQuantity::OfSpeed => it("K", "s"),
        CycleQuantity::Flywheel => it("I", "f"),
        CycleQuantity::Inertia => Rich::italic("I"),
        // Beside links θ₂ is the angle of link 2: there it is told as that at the mean.
        CycleQuantity::Crossing(k) if notation.mechanism().moving().next().is_some() => {
            it("θ", &format!("m{k}"))
        }
        CycleQuantity::Crossing(k) => it("θ", &k.to_string()),
        CycleQuantity::Area(k) => it("A", &k.to_string()),
        CycleQuantity::Level(k) => it("E", &k.to_string()),
        CycleQuantity::AtHighest => Rich::italic("θ").up("(").then(&it("E", "max")).up(")"),
        CycleQuantity::AtLowest => Rich::italic("θ").up("(").then(&it("E", "min")).up(")"),
        CycleQuantity::Most => it(notation.alpha(), "max"),
        CycleQuantity::Least => it(notation.alpha(), "min"),
        CycleQuantity::AtMost => Rich::italic("θ").up("(").then(&it(notation.alpha(), "max")).up(")"),
        CycleQuantity::AtLeast => Rich::italic("θ").up("(").then(&it(notation.alpha(), "min")).up(")"),
    }
}

/// What a number of the diagram is called.
pub(super) fn in_words(of: CycleQuantity, words: &Words) -> &'static str {
    let place = match of {
        CycleQuantity::Mean => 0,
        CycleQuantity::Work => 1,
        CycleQuantity::Power => 2,
        CycleQuantity::Highest => 3,
        CycleQuantity::Lowest => 4,
        CycleQuantity::Fluctuation => 5,
        CycleQuantity::OfEnergy => 6,
        CycleQuantity::OfSpeed => 7,
        CycleQuantity::Flywheel => 8,
        CycleQuantity::Inertia => 9,
        CycleQuantity::Crossing(_) => 10,
        CycleQuantity::Area(_) => 11,
        CycleQuantity::Level(_) => 12,
        CycleQuantity::AtHighest
        | CycleQuantity::AtLowest
        | CycleQuantity::AtMost
        | CycleQuantity::AtLeast => 13,
        CycleQuantity::Most => 14,
        CycleQuantity::Least => 15,
    };
    words.cycle_numbers[place]
}

/// A round number of units for a centimetre, so that this much has room in so many millimetres.
fn round_scale(size: f64, room: f64) -> f64 {
    let least = (size / room * 10.0).max(f64::MIN_POSITIVE);
    let power = libm::pow(10.0, libm::floor(libm::log10(least)));
    let step = STEPS.iter().find(|step| **step * power >= least * (1.0 - 1e-9));
    step.map_or(10.0 * power, |step| step * power)
}

/// The least and the greatest of the torques, with 0.
fn range(sheet: &CycleSheet) -> [f64; 2] {
    let torques = || sheet.curves.iter().flatten().map(|[_, torque]| *torque);
    [torques().fold(0.0, f64::min), torques().fold(0.0, f64::max)]
}

impl CyclePanel {
    /// What a diagram has.
    #[must_use]
    pub fn all(sheet: &CycleSheet) -> Vec<Self> {
        let mut all = Vec::new();
        if !sheet.curves[0].is_empty() {
            all.push(Self::TurningMoment);
        }
        if !sheet.levels.is_empty() {
            all.push(Self::Energy);
        }
        all
    }

    /// The name of the figure.
    #[must_use]
    pub const fn figure(self) -> &'static str {
        match self {
            Self::TurningMoment => "turning-moment",
            Self::Energy => "energy",
        }
    }

    /// Its title.
    #[must_use]
    pub fn title(self, notation: &Notation<'_>) -> Rich {
        let words = notation.words;
        Rich::upright(match self {
            Self::TurningMoment => words.turning_moment_figure,
            Self::Energy => words.energy_figure,
        })
    }

    /// N m, or J, for a millimetre.
    fn per_mm(self, sheet: &CycleSheet, notation: &Notation<'_>) -> f64 {
        let unit = notation.scene.units.torque.si;
        let (size, room) = match self {
            Self::TurningMoment => {
                let [least, most] = range(sheet);
                (most - least, PLOT.1)
            }
            Self::Energy => {
                let most = sheet.levels.iter().copied().fold(0.0, f64::max);
                let least = sheet.levels.iter().copied().fold(0.0, f64::min);
                (most - least, LEVELS)
            }
        };
        round_scale(size / unit, room) * unit / 10.0
    }

    /// Its scales.
    #[must_use]
    pub fn scale(self, sheet: &CycleSheet, notation: &Notation<'_>) -> Rich {
        let unit = &notation.scene.units.torque;
        let symbol = match self {
            Self::TurningMoment => unit.symbol.clone(),
            Self::Energy => energy_unit(&unit.symbol),
        };
        let value = human::with_unit(&human::stated(self.per_mm(sheet, notation) * 10.0 / unit.si), &symbol);
        let torque = value.up("\u{a0}≡\u{a0}1\u{a0}cm");
        if sheet.curves[0].is_empty() {
            return torque;
        }
        let angle = human::degrees(radians_per_mm(sheet) * 10.0).up("\u{a0}≡\u{a0}1\u{a0}cm");
        torque.up(notation.words.comma).then(&angle)
    }

    /// Its ink.
    #[must_use]
    pub fn draw(self, sheet: &CycleSheet, notation: &Notation<'_>) -> Group {
        match self {
            Self::TurningMoment => turning_moment(sheet, notation, Shown::Solution),
            Self::Energy => energy(sheet, notation),
        }
    }
}

/// How much of a turning-moment diagram is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Shown {
    /// The curves that the scene states.
    Given,
    /// Also the mean line, the crossings and the areas.
    Solution,
}

/// The curves of a question; none where the mechanism gives them, or where only areas are given. Of what several copies add
/// up to the curve of one is stated, and drawn.
pub(super) fn stated_curves(sheet: &CycleSheet, notation: &Notation<'_>) -> Option<(CycleSheet, Group)> {
    let cycle = notation.mechanism().forces.cycle.as_ref()?;
    let is_stated = |course: &Course| matches!(course, Course::Curve(_));
    let stated = match &cycle.sides {
        Sides::Torque(of) | Sides::Load(of) => is_stated(of),
        Sides::Both { torque, load } => is_stated(torque) && is_stated(load),
        Sides::Areas { .. } => false,
    };
    let sheet = match cycle.copies.number {
        _ if !stated => return None,
        1 => sheet.clone(),
        _ => of_one_copy(sheet, cycle),
    };
    let drawn = turning_moment(&sheet, notation, Shown::Given);
    Some((sheet, drawn))
}

/// The diagram with the curves of one copy; what is constant stays away.
fn of_one_copy(sheet: &CycleSheet, cycle: &Cycle) -> CycleSheet {
    /// Points of a wave over the period: a curve to the eye.
    const POINTS: u32 = 360;
    let alone = Cycle { copies: Copies { number: 1, ..cycle.copies }, ..cycle.clone() };
    let points = |course: &Course| {
        let Course::Curve(curve) = course else { return Vec::new() };
        match curve {
            Curve::Table { knots, period } => {
                let turns = libm::round(sheet.period / period.value).max(1.0) as u32;
                let knots: Vec<[f64; 2]> = knots.iter().map(|knot| knot.map(|given| given.value)).collect();
                let turned = |turn: u32| {
                    knots.iter().map(move |[at, size]| [at + f64::from(turn) * period.value, *size])
                };
                let mut all: Vec<[f64; 2]> = (0..turns).flat_map(turned).collect();
                // The curve goes on to the first knot of the next period, and came from the last one of the one before.
                let (first, last) = (all.first().copied(), all.last().copied());
                if let (Some(first), Some(last)) = (first, last) {
                    let across = [[last[0] - sheet.period, last[1]], first];
                    let at_ends = height(&across, 0.0);
                    if first[0] > 0.0 {
                        all.insert(0, [0.0, at_ends]);
                    }
                    if last[0] < sheet.period {
                        all.push([sheet.period, if first[0] > 0.0 { at_ends } else { first[1] }]);
                    }
                }
                all
            }
            Curve::Harmonics { .. } => {
                let Some(waves) = Waves::of(curve, &alone) else { return Vec::new() };
                let place = |k: u32| sheet.period * f64::from(k) / f64::from(POINTS);
                (0..=POINTS).map(|k| [place(k), waves.at(place(k))]).collect()
            }
        }
    };
    let mut own = sheet.clone();
    own.curves = match &cycle.sides {
        Sides::Torque(of) => [points(of), Vec::new()],
        Sides::Load(of) => [Vec::new(), points(of)],
        Sides::Both { torque, load } => [points(torque), points(load)],
        Sides::Areas { .. } => [Vec::new(), Vec::new()],
    };
    own
}

/// Newton metres and radians for a millimetre of the diagram, where it is drawn.
#[must_use]
pub fn paper(sheet: &CycleSheet, notation: &Notation<'_>) -> Option<[f64; 2]> {
    let drawn = !sheet.curves[0].is_empty();
    drawn.then(|| paper_of(sheet, notation))
}

/// The same of one that is drawn.
pub(super) fn paper_of(sheet: &CycleSheet, notation: &Notation<'_>) -> [f64; 2] {
    [CyclePanel::TurningMoment.per_mm(sheet, notation), radians_per_mm(sheet)]
}

/// A crossing farther from the mean than this part of it is a leap.
const LEAP: f64 = 1e-6;

/// Degrees for a centimetre.
const ANGLES: [f64; 14] = [1.0, 2.0, 3.0, 6.0, 10.0, 12.0, 15.0, 20.0, 30.0, 45.0, 60.0, 90.0, 120.0, 180.0];

fn radians_per_mm(sheet: &CycleSheet) -> f64 {
    let period = sheet.period.to_degrees();
    let fits = ANGLES.into_iter().find(|step| period / step * 10.0 <= PLOT.0 * (1.0 + 1e-9));
    fits.unwrap_or_else(|| round_scale(period, PLOT.0)).to_radians() / 10.0
}

/// The angles that are told at the axis: some ten of them, round in degrees.
fn told_angles(sheet: &CycleSheet) -> Vec<f64> {
    let whole = sheet.period.to_degrees();
    let steps = [1.0, 2.0, 5.0, 10.0, 15.0, 30.0, 60.0, 90.0, 180.0, 360.0, 720.0, 3600.0];
    let step = steps.into_iter().find(|step| whole / step <= 13.0).unwrap_or(whole);
    let mut told = Vec::new();
    let mut at = 0.0;
    while at <= whole * (1.0 + 1e-9) {
        told.push(at.to_radians());
        at += step;
    }
    told
}

/// The axis of angles with its numbers, and the axis that stands on it.
fn axes(
    group: &mut Group,
    sheet: &CycleSheet,
    [least, most]: [f64; 2],
    x: &dyn Fn(f64) -> f64,
    y: &dyn Fn(f64) -> f64,
) {
    let right = x(sheet.period) + 6.0;
    let zero = y(0.0);
    arrow(group, Point::new(x(0.0), zero), Point::new(right, zero), THIN);
    arrow(group, Point::new(x(0.0), y(least).max(zero)), Point::new(x(0.0), y(most) - 5.0), THIN);
    for at in told_angles(sheet) {
        let foot = Point::new(x(at), zero);
        let tick = Shape::Line(foot + Vec2::new(0.0, -0.6), foot + Vec2::new(0.0, 0.6));
        group.mark(Mark::stroke(tick, Pen::solid(FINE)).class("tick"));
    }
}

fn numbers_of_axis(requests: &mut Vec<Request>, sheet: &CycleSheet, x: &dyn Fn(f64) -> f64, zero: f64) {
    for at in told_angles(sheet) {
        let site = Site::Around { at: Point::new(x(at), zero), radius: 1.0, toward: Some(1.2) };
        let mut request = Request::new(human::degrees(at), TICK, site, "tick");
        request.optional = true;
        requests.push(request);
    }
}

/// The sense of the motion where the angle of the input falls: everything is told from right to left then.
fn way_of_motion(
    group: &mut Group,
    requests: &mut Vec<Request>,
    sheet: &CycleSheet,
    (x, bottom): (&dyn Fn(f64) -> f64, f64),
) {
    if !sheet.falling {
        return;
    }
    let from = Point::new(x(sheet.period), bottom + 8.0);
    let mut own = Group::new("way-of-motion");
    arrow(&mut own, from, from - Vec2::new(14.0, 0.0), THIN);
    group.group(own);
    let site = Site::Around { at: from, radius: 1.0, toward: Some(0.0) };
    requests.push(Request::new(Rich::italic("ω"), SMALL, site, "label motion-name"));
}

/// The height of a curve at an angle.
pub(super) fn height(curve: &[[f64; 2]], at: f64) -> f64 {
    let next = curve.partition_point(|[angle, _]| *angle <= at);
    match (next.checked_sub(1).and_then(|i| curve.get(i)), curve.get(next)) {
        (Some([a, from]), Some([b, to])) if b > a => from + (to - from) * (at - a) / (b - a),
        (Some([_, height]), _) | (None, Some([_, height])) => *height,
        (None, None) => 0.0,
    }
}

fn turning_moment(sheet: &CycleSheet, notation: &Notation<'_>, shown: Shown) -> Group {
    let unit = &notation.scene.units.torque;
    let per_mm = CyclePanel::TurningMoment.per_mm(sheet, notation);
    let per_angle = radians_per_mm(sheet);
    let mut group = Group::new("turning-moment")
        .data("scale", format!("{}", per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol))
        .data("radians-per-mm", format!("{per_angle}"));
    let x = |angle: f64| angle / per_angle;
    let y = |torque: f64| -torque / per_mm;
    let at = |[angle, torque]: [f64; 2]| Point::new(x(angle), y(torque));
    // Areas first, under the curves.
    let inside = |from: f64, to: f64, positive: bool, group: &mut Group| {
        let mut own = Group::new(if positive { "area above" } else { "area below" });
        let strokes = ((x(to) - x(from)) / HATCH).ceil().max(1.0) as u32;
        for k in 0..strokes {
            let angle = from + (to - from) * (f64::from(k) + 0.5) / f64::from(strokes);
            let angle = if angle >= sheet.period { angle - sheet.period } else { angle };
            let ends = [0, 1].map(|side| Point::new(x(angle), y(height(&sheet.curves[side], angle))));
            if ends[0].distance(ends[1]) > 0.4 {
                let dash = if positive { Dash::Solid } else { Dash::Dashed };
                own.mark(
                    Mark::stroke(Shape::Line(ends[0], ends[1]), Pen { width: 0.13, dash }).class("hatch"),
                );
            }
        }
        group.group(own);
    };
    let mut requests = Vec::new();
    let crossings = if shown == Shown::Solution { sheet.crossings.as_slice() } else { &[] };
    for (index, crossing) in crossings.iter().enumerate() {
        let next = sheet.crossings.get(index + 1).unwrap_or(&sheet.crossings[0]).at;
        // From left to right, whichever way the motion goes.
        let [from, to] = if sheet.falling { [next, crossing.at] } else { [crossing.at, next] };
        let over = to <= from;
        inside(from, if over { to + sheet.period } else { to }, crossing.rises, &mut group);
        // The widest part of an area that goes over the end of the period has its number.
        let parts = if over { vec![[from, sheet.period], [0.0, to]] } else { vec![[from, to]] };
        let widest = parts.into_iter().max_by(|a, b| (a[1] - a[0]).total_cmp(&(b[1] - b[0])));
        if let Some([from, to]) = widest.filter(|[from, to]| x(*to) - x(*from) > NARROW) {
            let middle = f64::midpoint(from, to);
            let heights = [0, 1].map(|side| height(&sheet.curves[side], middle));
            let place = at([middle, f64::midpoint(heights[0], heights[1])]);
            let sign = if crossing.rises { "+" } else { "−" };
            let text = Rich::upright(format!("{sign}({})", index + 1));
            let site = Site::Around { at: place, radius: 0.2, toward: None };
            let mut request = Request::new(text, TICK, site, "label area-name");
            request.leader = true;
            requests.push(request);
        }
    }
    axes(&mut group, sheet, range(sheet), &x, &y);
    for side in [1, 0] {
        let points: Vec<Point> = sheet.curves[side].iter().map(|point| at(*point)).collect();
        let constant = sheet.constant == Some(side);
        if constant && shown == Shown::Given {
            continue;
        }
        let pen = match (side, constant) {
            (_, true) => Pen { width: THIN, dash: Dash::Dashed },
            (0, _) => Pen::solid(THICK * 0.8),
            _ => Pen::solid(THIN),
        };
        let class = match (side, constant) {
            (_, true) => "mean-line",
            (0, _) => "curve torque",
            _ => "curve load",
        };
        // A mean line is two points.
        let points = match (constant, points.first(), points.last()) {
            (true, Some(first), Some(last)) => vec![*first, *last],
            _ => points,
        };
        let mut own = Group::new(class);
        own.mark(Mark::stroke(Shape::Polyline(points.clone()), pen).precise());
        group.group(own);
        if let Some(end) = points.last() {
            let name = match (side, constant) {
                (_, true) => symbol(notation, CycleQuantity::Mean),
                (0, _) => Rich::italic("T"),
                _ => Rich::italic("T").sub("l"),
            };
            let site = Site::Around { at: *end, radius: 1.0, toward: Some(0.0) };
            let mut request = Request::new(name, SMALL, site, "label curve-name");
            request.leader = true;
            requests.push(request);
        }
    }
    let mean = sheet.constant.and_then(|side| sheet.curves[side].first()).map(|[_, mean]| *mean);
    for (index, crossing) in crossings.iter().enumerate() {
        // Where the curve leaps over the mean line, the crossing is on that line.
        let leaps = |mean: &f64| (crossing.torque - mean).abs() > LEAP * mean.abs();
        let place = at([crossing.at, mean.filter(leaps).unwrap_or(crossing.torque)]);
        group.mark(dot(place, 0.55).class("crossing"));
        let [highest, lowest] = sheet.extremes.unwrap_or([usize::MAX; 2]);
        let speed = |sub: &str| Some(Rich::italic("ω").sub(sub));
        let name = match index {
            index if index == highest => speed("max"),
            index if index == lowest => speed("min"),
            _ => None,
        };
        if let Some(name) = name {
            let site = Site::Around { at: place, radius: 1.0, toward: Some(1.5) };
            let mut request = Request::new(name, SMALL, site, "label speed-name");
            request.leader = true;
            requests.push(request);
        }
    }
    strokes_of_engine(&mut group, &mut requests, sheet, notation, (&x, y(range(sheet)[1])));
    way_of_motion(&mut group, &mut requests, sheet, (&x, y(range(sheet)[0]).max(y(0.0))));
    numbers_of_axis(&mut requests, sheet, &x, y(0.0));
    let top = Point::new(x(0.0), y(range(sheet)[1]) - 5.0);
    let name = Rich::italic("T").up("\u{a0}/\u{a0}").up(&human::pretty(&unit.symbol));
    requests.push(Request::new(
        name,
        SMALL,
        Site::Around { at: top, radius: 1.0, toward: Some(0.4) },
        "label axis-name",
    ));
    let right = Point::new(x(sheet.period) + 6.0, y(0.0));
    let site = Site::Around { at: right, radius: 1.0, toward: Some(-0.8) };
    requests.push(Request::new(Rich::italic("θ"), SMALL, site, "label axis-name"));
    let names = place(&group, &requests, None);
    group.group(names);
    group
}

/// The names of the strokes of a four-stroke engine, over two turns that the mechanism itself drives.
fn strokes_of_engine(
    group: &mut Group,
    requests: &mut Vec<Request>,
    sheet: &CycleSheet,
    notation: &Notation<'_>,
    (x, top): (&dyn Fn(f64) -> f64, f64),
) {
    let two_turns = (sheet.period.to_degrees() - 720.0).abs() < 1e-6;
    let drives = notation.scene.mechanism.forces.cycle.as_ref().is_some_and(|cycle| {
        let torque = match &cycle.sides {
            Sides::Torque(torque) | Sides::Both { torque, .. } => Some(torque),
            Sides::Load(_) | Sides::Areas { .. } => None,
        };
        cycle.copies.number == 1
            && torque.is_some_and(|torque| matches!(torque, Course::Of(_) | Course::Curve(_)))
    });
    if !two_turns || !drives {
        return;
    }
    for (index, name) in notation.words.engine_strokes.iter().enumerate() {
        let quarter = sheet.period / 4.0;
        let [from, to] = [index, index + 1].map(|k| x(quarter * k as f64));
        let line = top - 9.0;
        let mut own = Group::new("stroke-of-engine");
        own.mark(Mark::stroke(Shape::Line(Point::new(from, line), Point::new(to, line)), Pen::solid(FINE)));
        for end in [from, to] {
            let tick = Shape::Line(Point::new(end, line - 1.0), Point::new(end, line + 1.0));
            own.mark(Mark::stroke(tick, Pen::solid(FINE)));
        }
        group.group(own);
        let site = Site::Along { from: Point::new(from, line), to: Point::new(to, line) };
        requests.push(Request::new(Rich::upright(*name), SMALL, site, "label stroke-name"));
    }
}

fn energy(sheet: &CycleSheet, notation: &Notation<'_>) -> Group {
    let unit = &notation.scene.units.torque;
    let per_mm = CyclePanel::Energy.per_mm(sheet, notation);
    let mut group = Group::new("energy")
        .data("scale", format!("{}", per_mm / unit.si))
        .data("unit", format!("{} per mm", unit.symbol));
    let y = |level: f64| -level / per_mm;
    let by_angle = !sheet.crossings.is_empty();
    let per_angle = radians_per_mm(sheet);
    let count = sheet.levels.len();
    // Areas alone do not say at which angle: their levels stand side by side.
    let x = |angle: f64| angle / per_angle;
    let place_of = |index: usize| match sheet.crossings.get(index) {
        Some(crossing) => x(crossing.at),
        None => PLOT.0 * (index as f64 + 1.0) / count.max(1) as f64,
    };
    let width = if by_angle { x(sheet.period) } else { PLOT.0 };
    let mut requests = Vec::new();
    let most = sheet.levels.iter().copied().fold(0.0, f64::max);
    if by_angle {
        axes(&mut group, sheet, [0.0, most], &x, &y);
        numbers_of_axis(&mut requests, sheet, &x, 0.0);
        let least = sheet.levels.iter().copied().fold(0.0, f64::min);
        way_of_motion(&mut group, &mut requests, sheet, (&x, y(least)));
    } else {
        arrow(&mut group, Point::ORIGIN, Point::new(width + 6.0, 0.0), THIN);
        arrow(&mut group, Point::ORIGIN, Point::new(0.0, y(most) - 5.0), THIN);
    }
    let tops: Vec<Point> = sheet
        .levels
        .iter()
        .enumerate()
        .map(|(index, level)| Point::new(place_of(index), y(*level)))
        .collect();
    let points: Vec<Point> = match by_angle {
        true => sheet.energy.iter().map(|[angle, level]| Point::new(x(*angle), y(*level))).collect(),
        false => std::iter::once(Point::ORIGIN).chain(tops.iter().copied()).collect(),
    };
    let mut own = Group::new("curve levels");
    own.mark(Mark::stroke(Shape::Polyline(points), Pen::solid(THIN)));
    group.group(own);
    for (index, at) in tops.iter().enumerate() {
        let foot = Point::new(at.x, 0.0);
        let mut own = Group::new("level").data("value", format!("{}", sheet.levels[index] / unit.si));
        own.mark(Mark::stroke(Shape::Line(foot, *at), Pen { width: FINE, dash: Dash::Dashed }).precise());
        own.mark(dot(*at, 0.55));
        group.group(own);
        let extreme = sheet.extremes.unwrap_or([usize::MAX; 2]);
        let name = if index == extreme[0] {
            symbol(notation, CycleQuantity::Highest)
        } else if index == extreme[1] {
            symbol(notation, CycleQuantity::Lowest)
        } else {
            symbol(notation, CycleQuantity::Level(u32::try_from(index + 1).unwrap_or(u32::MAX)))
        };
        let up = if sheet.levels[index] < 0.0 { 1.57 } else { -1.57 };
        let site = Site::Around { at: *at, radius: 0.9, toward: Some(up) };
        let mut request = Request::new(name, SMALL, site, "label level-name");
        request.leader = true;
        requests.push(request);
    }
    if let Some([highest, lowest]) = sheet.extremes {
        let right = width + 12.0;
        let ends = [highest, lowest].map(|index| Point::new(right, y(sheet.levels[index])));
        for (end, index) in ends.iter().zip([highest, lowest]) {
            let from = Point::new(place_of(index), end.y);
            let mut own = Group::new("reach");
            let to = *end + Vec2::new(2.0, 0.0);
            own.mark(Mark::stroke(Shape::Line(from, to), Pen { width: FINE, dash: Dash::Dashed }));
            group.group(own);
        }
        let mut own = Group::new("dimension").data("quantity", "Ef");
        let middle = ends[0].midpoint(ends[1]);
        arrow(&mut own, middle, ends[0], THIN);
        arrow(&mut own, middle, ends[1], THIN);
        group.group(own);
        let site = Site::Along { from: ends[0], to: ends[1] };
        requests.push(Request::new(
            symbol(notation, CycleQuantity::Fluctuation),
            SMALL,
            site,
            "label dimension",
        ));
    }
    let top = Point::new(0.0, y(most) - 5.0);
    let name = Rich::italic("E").up("\u{a0}/\u{a0}").up(&human::pretty(&energy_unit(&unit.symbol)));
    requests.push(Request::new(
        name,
        SMALL,
        Site::Around { at: top, radius: 1.0, toward: Some(0.4) },
        "label axis-name",
    ));
    let names = place(&group, &requests, None);
    group.group(names);
    group
}

/// Energies are told in the unit of torques.
pub(super) fn energy_unit(symbol: &str) -> String {
    if symbol == "N*m" { "J".to_owned() } else { symbol.to_owned() }
}

/// No more knots or areas are told one by one.
pub(super) const TOLD: usize = 24;

/// What a scene states of its diagram and of a governor.
pub(super) fn given(notation: &Notation<'_>, parts: &mut Vec<Rich>) {
    let forces = &notation.mechanism().forces;
    let units = &notation.scene.units;
    let equals = |symbol: Rich, value: &Rich| symbol.up("\u{a0}=\u{a0}").then(value);
    let rate = notation.angular_unit(Order::Velocity);
    if let Some(spin) = &forces.spin {
        let place = spin.through.map(|c| human::stated(c.value / units.length.si));
        let through = Rich::upright("(").then(&place[0]).up(";\u{a0}").then(&place[1]).up(")");
        let axis = human::with_unit(&through, &units.length.symbol)
            .up(" ∠\u{a0}")
            .then(&human::degrees(spin.angle.value));
        parts.push(Rich::fill(notation.words.given_axis, &[("place", axis)]));
        if let SpinSpeed::Given(omega) = spin.omega {
            let unit = notation.scene.spin_unit.as_ref().unwrap_or(&rate);
            parts.push(equals(Rich::italic("ω"), &human::stated_quantity(omega.value, unit)));
        }
        if spin.balls > 1 {
            let count = ("count", human::stated(f64::from(spin.balls)));
            parts.push(Rich::fill(notation.words.given_halves, &[count]));
            parts.extend(spin.sleeve.filter(|link| forces.acts_on(*link)).map(|link| {
                let link = ("link", Rich::upright(notation.number(link)));
                Rich::fill(notation.words.given_sleeve, &[link])
            }));
        }
        if let Some(drag) = spin.drag {
            let name = Rich::upright(notation.words.given_sleeve_friction).up("\u{a0}").it("F").sub("f");
            parts.push(equals(name, &human::stated_quantity(drag.size.value, &units.force)));
        }
    }
    let Some(cycle) = &forces.cycle else { return };
    let torque = Rich::italic("T");
    let load = Rich::italic("T").sub("l");
    let mut course = |symbol: Rich, course: &Course| match course {
        // The mechanism's own torque is told with its loads.
        Course::Of(_) => {}
        Course::Curve(curve) => {
            parts.push(symbol.up("(").it("θ").up(")\u{a0}=\u{a0}").then(&of_curve(curve, &units.torque)))
        }
    };
    match &cycle.sides {
        Sides::Torque(of) => course(torque, of),
        Sides::Load(of) => course(load, of),
        Sides::Both { torque: one, load: other } => {
            course(torque, one);
            course(load, other);
        }
        Sides::Areas { areas, torque, angle, total } => {
            let list: Vec<Rich> = areas.iter().take(TOLD).map(|area| human::stated(area.value)).collect();
            let [between, whole] = notation.words.given_areas;
            let between = Rich::upright(between).up("\u{a0}").it("A");
            parts.push(equals(between, &Rich::join(&list, &Rich::upright(";\u{a0}"))));
            if let Some(total) = total {
                let whole = Rich::upright(whole).up("\u{a0}Σ");
                parts.push(equals(whole, &human::stated(total.value)));
            }
            let scale = human::stated_quantity(torque.value, &units.torque);
            // A unit of length along each axis.
            parts.push(
                Rich::upright(format!("1\u{a0}{}²\u{a0}≡\u{a0}", units.length.symbol))
                    .then(&scale)
                    .up(" ·\u{a0}")
                    .then(&human::degrees(angle.value)),
            );
        }
    }
    let [steady_load, steady_torque] = notation.words.given_steady;
    match &cycle.sides {
        Sides::Torque(_) => parts.push(Rich::upright(steady_load)),
        Sides::Load(_) => parts.push(Rich::upright(steady_torque)),
        Sides::Both { .. } | Sides::Areas { .. } => {}
    }
    let period = Rich::upright(notation.words.given_period).up("\u{a0}").it("θ").sub("C");
    parts.push(equals(period, &human::degrees(cycle.period.value)));
    if cycle.copies.number > 1 {
        let number = human::stated(f64::from(cycle.copies.number));
        let shift = human::degrees(cycle.copies.shift.value);
        parts.push(Rich::fill(notation.words.given_copies, &[("number", number), ("shift", shift)]));
    }
    if notation.mechanism().inputs.is_empty() && cycle.omega.value != 0.0 {
        let stated = notation.scene.input_units.first().and_then(|input| input.rate.as_ref());
        let value = human::stated_quantity(cycle.omega.value, stated.unwrap_or(&rate));
        parts.push(equals(Rich::italic("ω"), &value));
    }
    if let Some(wanted) = cycle.fluctuation {
        let name = Rich::upright(in_words(CycleQuantity::OfSpeed, notation.words)).up("\u{a0}");
        let name = name.then(&symbol(notation, CycleQuantity::OfSpeed));
        parts.push(equals(name, &human::stated(wanted.value)));
    }
    let mut turning = Vec::new();
    for (index, rotating) in cycle.rotating.iter().enumerate() {
        let sub = if cycle.rotating.len() > 1 { (index + 1).to_string() } else { String::new() };
        let named = |letter: &str| Rich::italic(letter).sub(&sub);
        match rotating.inertia {
            RotatingInertia::Central(inertia) => {
                let own = own_inertia(cycle, &sub, rotating);
                turning.push(equals(own, &human::stated_quantity(inertia.value, &units.inertia)));
            }
            RotatingInertia::Mass(mass, radius) => {
                turning.push(equals(named("M"), &human::stated_quantity(mass.value, &units.mass)));
                turning.push(equals(named("ρ"), &human::stated_quantity(radius.value, &units.length)));
            }
            RotatingInertia::Weight(weight, radius) => {
                turning.push(equals(named("W"), &human::stated_quantity(weight.value, &units.force)));
                turning.push(equals(named("ρ"), &human::stated_quantity(radius.value, &units.length)));
            }
        }
        if rotating.ratio.value != 1.0 {
            let several = cycle.rotating.len() > 1;
            turning.push(equals(given_ratio(index, several, notation), &human::stated(rotating.ratio.value)));
        }
    }
    if !turning.is_empty() {
        let list = Rich::join(&turning, &Rich::upright(notation.words.comma));
        parts.push(Rich::fill(notation.words.given_rotating, &[("list", list)]));
    }
}

/// A curve as it is given: its knots, or its sum of waves.
pub(super) fn of_curve(curve: &Curve, unit: &Unit) -> Rich {
    let told = match curve {
        Curve::Table { knots, .. } => {
            let knot = |at: f64, size: f64| {
                let size = human::stated(size / unit.si);
                Rich::upright("(").then(&human::degrees(at)).up(";\u{a0}").then(&size).up(")")
            };
            let first = knots.iter().take(TOLD);
            let mut list: Vec<Rich> = first.map(|[at, size]| knot(at.value, size.value)).collect();
            if knots.len() > TOLD {
                list.push(Rich::upright("…"));
            }
            Rich::join(&list, &Rich::upright(" "))
        }
        Curve::Harmonics { constant, sin, cos } => {
            let mut sum = human::stated(constant.value / unit.si);
            let waves = sin.iter().map(|wave| (wave, "sin")).chain(cos.iter().map(|wave| (wave, "cos")));
            for (wave, name) in waves {
                let size = wave.size.value / unit.si;
                let sign = if size < 0.0 { " −\u{a0}" } else { " +\u{a0}" };
                sum = sum.up(sign).then(&human::stated(size.abs())).up(&format!("\u{a0}{name}\u{a0}"));
                if wave.order.value != 1.0 {
                    sum = sum.then(&human::stated(wave.order.value));
                }
                sum = sum.it("θ");
            }
            Rich::upright("(").then(&sum).up(")")
        }
    };
    // Wherever a line breaks, it is read from left to right.
    human::with_unit(&told, &unit.symbol).island()
}

/// What is told of a diagram: its areas, its levels, and how far these lie apart.
pub(super) fn items(sheet: &CycleSheet, notation: &Notation<'_>, figures: &RefCell<Figures>) -> Vec<Item> {
    let (mean, areas, rest) = Computed { sheet, notation, figures }.lines();
    let mut items = vec![Item::Head(Rich::bold(notation.words.turning_moment_figure))];
    items.extend(mean.into_iter().chain(areas.into_iter().flatten()).map(Item::Sentence));
    if let Some([highest, lowest]) = sheet.extremes {
        let counted = |k: usize| u32::try_from(k + 1).unwrap_or(u32::MAX);
        let part = |quantity: CycleQuantity, of: CycleQuantity| {
            symbol(notation, quantity).up("\u{a0}=\u{a0}").then(&symbol(notation, of))
        };
        let mut told = vec![
            part(CycleQuantity::Highest, CycleQuantity::Level(counted(highest))),
            part(CycleQuantity::Lowest, CycleQuantity::Level(counted(lowest))),
        ];
        for (of, k) in [(CycleQuantity::AtHighest, highest), (CycleQuantity::AtLowest, lowest)] {
            let asked = &notation.mechanism().asked;
            if asked.iter().any(|asked| asked.quantity == Quantity::Cycle(of)) {
                told.push(part(of, CycleQuantity::Crossing(counted(k))));
            }
        }
        items.push(Item::Sentence(Rich::join(&told, &Rich::upright(notation.words.comma)).up(".")));
    }
    items.extend(rest.into_iter().map(Item::Sentence));
    items
}
