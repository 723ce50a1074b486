//! Diagrams of a sweep: quantities over the input or over time, paths of points, hodographs, polar diagrams; with
//! axes and numbered positions.

use std::f64::consts::PI;

use kurbo::{BezPath, Point, Rect, Vec2};

use super::figure::{Figure, Group, Mark, Pen, Shape};
use super::ink::{FINE, SMALL, THICK, THIN, dot};
use super::labels::{self, Request, Site};
use super::motions::{self, Panel, Rate};
use super::notation::Notation;
use super::rich::{Line, Rich};
use super::{Language, human};
use crate::board::Dual;
use crate::mechanism::quantity::{Quantity, Unit};
use crate::scene::Scene;
use crate::sweep::{InputKind, Stretch, Sweep, Table, Track};

/// Width of the page, mm.
const PAGE: f64 = 190.0;
/// What does not go on one page is parted into pages of A4.
const PAPER: (f64, f64) = (210.0, 297.0);
/// Blank around the page.
const MARGIN: f64 = 10.0;
/// A panel with its names.
const PANEL: (f64, f64) = (85.0, 74.0);
/// How much lower a panel is that has another one below it on the same axis.
const STACKED: f64 = 8.0;
/// The plot in a panel: left, top, width, height.
const PLOT: (f64, f64, f64, f64) = (15.0, 9.0, 66.0, 50.0);
/// A fitted curve stays this near to the truth, mm.
const ACCURACY: f64 = 0.01;
/// Values larger than this many times what nine of ten stay below are cut off: towards a limit of the input
/// speeds grow without end.
const CUT: f64 = 3.0;
/// Positions that are marked and numbered on paths and hodographs.
const NUMBERED: u32 = 12;
/// Size of tick labels.
const TICK: f64 = 2.6;

/// A sweep that has been looked at: all diagrams are read off the same tables, one for each stretch.
struct Seen<'s> {
    sweep: &'s Sweep,
    tables: Vec<Table>,
}

impl<'s> Seen<'s> {
    fn new(sweep: &'s Sweep) -> Self {
        Self { sweep, tables: sweep.stretches.iter().map(|stretch| sweep.table(stretch)).collect() }
    }

    /// These columns at a place; `None` where the mechanism cannot be assembled.
    fn at(&self, at: f64, columns: &[usize]) -> Option<Vec<Option<Dual>>> {
        let stretch = self.sweep.stretches.iter().position(|s| (s.from..=s.to).contains(&at))?;
        self.tables.get(stretch).map(|table| table.at(at, columns))
    }

    /// These columns at places over the range, within each stretch.
    fn looks(&self, columns: &[usize]) -> Vec<Vec<Option<Dual>>> {
        let whole = self.sweep.range[1] - self.sweep.range[0];
        let in_stretch = |(stretch, table): (&Stretch, &Table)| {
            let part = (stretch.to - stretch.from) / whole;
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a part of the looks"
            )]
            let count = (f64::from(self.sweep.looks() / 2) * part).ceil().max(8.0) as u32;
            let way = stretch.to - stretch.from;
            (0..=count)
                .map(|i| table.at(stretch.from + way * (f64::from(i) / f64::from(count)), columns))
                .collect::<Vec<_>>()
        };
        self.sweep.stretches.iter().zip(&self.tables).flat_map(in_stretch).collect()
    }
}

/// The diagrams of everything that was asked.
#[must_use]
pub fn of_sweep(scene: &Scene, sweep: &Sweep, language: Language) -> Figure {
    of_sweep_with(scene, sweep, language, None)
}

/// As [`of_sweep`], with a note of what the independent solver does not confirm.
#[must_use]
pub fn of_sweep_with(scene: &Scene, sweep: &Sweep, language: Language, unconfirmed: Option<&str>) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let mut first = Group::new("page");
    let title = scene.title.in_language(words.tag).unwrap_or(words.sweep).to_owned();
    // A page of Arabic script begins on the right.
    let begin = |line: &Line, left: f64, width: f64| {
        if words.right_to_left { left + width - line.width } else { left }
    };
    let line = PAGE - 2.0 * MARGIN;
    let mut top = MARGIN + 4.0;
    for text in Rich::bold(&title).wrap(5.0, line) {
        let head = text.set(5.0);
        head.put(&mut first, Point::new(begin(&head, MARGIN, line), top), "title");
        top += 6.5;
    }
    let note = unconfirmed.map(|why| Rich::fill(words.sweep_unconfirmed, &[("why", Rich::upright(why))]));
    let notes = note.into_iter().map(|note| (note, "unconfirmed"));
    let seen = Seen::new(sweep);
    let stacks = motions::stacks(sweep, |columns| seen.looks(columns));
    let numbered = |panel: &Panel| matches!(panel, Panel::Plane(_) | Panel::Polar(_));
    let caption = caption(&notation, sweep, stacks.iter().flatten().any(numbered));
    for (caption, class) in notes.chain([(caption, "caption")]) {
        for text in caption.wrap(SMALL, line) {
            let below = text.set(SMALL);
            below.put(&mut first, Point::new(begin(&below, MARGIN, line), top), class);
            top += 4.5;
        }
    }
    let mut pages = vec![first];
    // How far each of the two columns of a page is filled; of Arabic script the right one comes first.
    let mut filled = [top; 2];
    let bottom = PAPER.1 - MARGIN;
    for stack in &stacks {
        let tall: f64 = (0..stack.len()).map(|i| height_of(i + 1 == stack.len())).sum();
        let mut column = usize::from(filled[1] < filled[0]);
        if filled[column] + tall > bottom {
            column = 1 - column;
        }
        if filled[column] + tall > bottom {
            pages.push(Group::new("page"));
            (filled, column) = ([MARGIN; 2], 0);
        }
        let side = if words.right_to_left { 1 - column } else { column };
        #[expect(clippy::cast_precision_loss, reason = "two columns")]
        let left = MARGIN + side as f64 * PANEL.0;
        for (i, panel) in stack.iter().enumerate() {
            let last = i + 1 == stack.len();
            let mut group = match panel {
                Panel::Over(_) | Panel::Along(..) => over(&notation, &seen, panel, last),
                Panel::Plane(columns) => plane(&seen, *columns),
                Panel::Polar(columns) => polar(&seen, *columns),
            };
            let heading = heading_of(&notation, sweep, panel).set(SMALL);
            heading.put(&mut group, Point::new(begin(&heading, 2.0, PANEL.0 - 6.0), 5.0), "heading");
            group.translate(Vec2::new(left, filled[column]));
            filled[column] += height_of(last);
            if let Some(page) = pages.last_mut() {
                page.group(group);
            }
        }
    }
    let (mut root, mut width, mut height) = (Group::new("diagrams"), PAGE, 0.0);
    if pages.len() > 1 {
        width = PAPER.0;
        for mut page in pages {
            page.translate(Vec2::new((PAPER.0 - PAGE) / 2.0, height));
            height += PAPER.1;
            root.group(page);
        }
    } else {
        height = filled[0].max(filled[1]) + MARGIN;
        root.children = pages.pop().unwrap_or_default().children;
    }
    Figure {
        width,
        height,
        title,
        description: words.sweep_description.to_owned(),
        language: words.tag,
        root,
    }
}

/// What is varied, its range, how long that takes, and what the numbers mean where curves are `numbered`.
fn caption(notation: &Notation<'_>, sweep: &Sweep, numbered: bool) -> Rich {
    let words = notation.words;
    let unit = input_unit(notation, sweep);
    // In the order of the motion: an angle that turns clockwise grows smaller.
    let [from, to] = sweep.passed();
    let parts = [
        ("symbol", input_symbol(notation, sweep)),
        ("from", human::stated_quantity(from, &unit)),
        ("to", human::quantity(to, &unit)),
    ];
    let mut text = Rich::fill(words.sweep_range, &parts);
    if sweep.rate != 0.0 && sweep.input != InputKind::Time {
        let time = human::quantity((to - from) / sweep.rate, &notation.scene.units.time);
        text = text.up(words.comma).then(&Rich::fill(words.sweep_duration, &[("time", time)]));
    }
    if sweep.is_backwards() {
        text = text.up(words.comma).up(words.sweep_backwards);
    }
    if !numbered {
        return text;
    }
    let ends = [("first", 0), ("last", NUMBERED - 1)].map(|(name, n)| (name, Rich::upright(n.to_string())));
    text.up(words.semicolon).then(&Rich::fill(words.sweep_numbers, &ends))
}

fn input_unit(notation: &Notation<'_>, sweep: &Sweep) -> Unit {
    match sweep.input {
        InputKind::Angle(_) => Unit { symbol: "deg".to_owned(), si: PI / 180.0 },
        InputKind::Slide(_) => notation.scene.units.length.clone(),
        InputKind::Time => notation.scene.units.time.clone(),
    }
}

fn input_symbol(notation: &Notation<'_>, sweep: &Sweep) -> Rich {
    match sweep.input {
        InputKind::Angle(link) => notation.symbol(Quantity::Angle(link), false),
        InputKind::Slide(_) => Rich::italic("s"),
        InputKind::Time => Rich::italic("t"),
    }
}

/// A heading such as `ω₃ in rad/s`.
fn with_unit(notation: &Notation<'_>, symbol: Rich, unit: &Unit) -> Rich {
    if unit.symbol.is_empty() {
        return symbol;
    }
    if unit.symbol == "deg" {
        return Rich::fill(notation.words.in_degrees, &[("symbol", symbol)]);
    }
    let unit = Rich::upright(human::pretty(&unit.symbol));
    Rich::fill(notation.words.in_unit, &[("symbol", symbol), ("unit", unit)])
}

/// Of a place the path is drawn, of any other vector the hodograph.
fn is_place(quantity: Quantity) -> bool {
    matches!(quantity, Quantity::Position(_) | Quantity::Centre(..))
}

/// What a panel shows, in its unit.
fn heading_of(notation: &Notation<'_>, sweep: &Sweep, panel: &Panel) -> Rich {
    let words = notation.words;
    let columns = panel.columns();
    let Some(column) = columns.first().and_then(|&c| sweep.columns.get(c)) else { return Rich::default() };
    let vector = columns.len() == 2 && !is_place(column.asked.quantity);
    let symbol = notation.symbol(column.asked.quantity, vector);
    let length = || Rich::upright("|").then(&symbol).up("|");
    let named = match (panel, column.axis) {
        (Panel::Along(_, along), _) => {
            let angle = human::degrees(motions::direction(*along));
            let symbol = match column.asked.quantity {
                Quantity::Position(point) => Rich::italic("s").sub(&notation.index(point)),
                _ => symbol,
            };
            Rich::fill(words.along, &[("symbol", symbol), ("angle", angle)])
        }
        (Panel::Over(_), _) if vector => length(),
        (Panel::Over(_), Some(axis)) => {
            let axis = Rich::italic(["x", "y"][axis]);
            Rich::fill(words.coordinate_of, &[("axis", axis), ("symbol", symbol)])
        }
        (Panel::Over(_), None) => symbol,
        (Panel::Plane(_), _) if vector => Rich::fill(words.hodograph_of, &[("symbol", symbol)]),
        (Panel::Plane(_), _) => Rich::fill(words.path_of, &[("symbol", symbol)]),
        (Panel::Polar(_), _) => {
            let input = input_symbol(notation, sweep);
            Rich::fill(words.polar_of, &[("symbol", length()), ("input", input)])
        }
    };
    with_unit(notation, named, &column.asked.unit)
}

/// Least and greatest of some numbers; what runs away to infinity is cut.
fn bounds(numbers: impl Iterator<Item = f64>) -> [f64; 2] {
    let mut sorted: Vec<f64> = numbers.filter(|x| x.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (Some(&low), Some(&high)) = (sorted.first(), sorted.last()) else { return [0.0, 1.0] };
    let at = |part: usize| sorted[(sorted.len() - 1) * part / 20];
    let body = (at(19) - at(1)).max(at(19).abs().max(at(1).abs()) * 1e-3);
    [low.max(at(1) - CUT * body), high.min(at(19) + CUT * body)]
}

/// Round numbers between two ends: at most six.
fn ticks(low: f64, high: f64) -> Vec<f64> {
    let step = super::scale::round_up((high - low) / 5.0).unwrap_or(1.0);
    let (first, last) = ((low / step).ceil(), (high / step + 1e-9).floor());
    #[expect(clippy::cast_possible_truncation, reason = "a few steps")]
    let (first, last) = (first as i64, last as i64);
    #[expect(clippy::cast_precision_loss, reason = "small whole numbers")]
    (first..=last).map(|i| i as f64 * step).collect()
}

/// A frame with ticks on both axes; `map` takes numbers in their units to the page.
struct Axes {
    plot: Rect,
    x: [f64; 2],
    y: [f64; 2],
}

impl Axes {
    fn map(&self, x: f64, y: f64) -> Point {
        let part = |v: f64, [low, high]: [f64; 2]| (v - low) / (high - low);
        Point::new(
            self.plot.x0 + part(x, self.x) * self.plot.width(),
            self.plot.y1 - part(y, self.y) * self.plot.height(),
        )
    }

    fn scale(&self) -> Vec2 {
        let per = |[low, high]: [f64; 2], size: f64| size / (high - low);
        Vec2::new(per(self.x, self.plot.width()), -per(self.y, self.plot.height()))
    }

    /// The axes; the numbers of the lower one only where nothing below has the same.
    fn draw(&self, group: &mut Group, x_ticks: &[f64], numbers: bool) {
        let plot = self.plot;
        let corners =
            vec![Point::new(plot.x0, plot.y0), Point::new(plot.x0, plot.y1), Point::new(plot.x1, plot.y1)];
        group.mark(Mark::stroke(Shape::Polyline(corners), Pen::solid(THIN)).class("axis"));
        for &x in x_ticks {
            let at = self.map(x, self.y[0]);
            group.mark(
                Mark::stroke(Shape::Line(at, at + Vec2::new(0.0, 1.2)), Pen::solid(FINE)).class("tick"),
            );
            if numbers {
                let text = human::stated(x).set(TICK);
                text.put(group, at + Vec2::new(-text.width / 2.0, 4.0), "tick");
            }
        }
        for y in ticks(self.y[0], self.y[1]) {
            let at = self.map(self.x[0], y);
            group.mark(
                Mark::stroke(Shape::Line(at, at - Vec2::new(1.2, 0.0)), Pen::solid(FINE)).class("tick"),
            );
            let text = human::stated(y).set(TICK);
            text.put(group, at + Vec2::new(-1.8 - text.width, 0.9), "tick");
        }
        if self.y[0] < 0.0 && self.y[1] > 0.0 {
            let (a, b) = (self.map(self.x[0], 0.0), self.map(self.x[1], 0.0));
            group.mark(Mark::stroke(Shape::Line(a, b), Pen::chain(FINE)).class("zero"));
        }
    }
}

/// Height of a panel; the last of a stack has the axis with its numbers.
fn height_of(last: bool) -> f64 {
    if last { PANEL.1 } else { PANEL.1 - STACKED }
}

fn plot_area() -> Rect {
    Rect::from_origin_size((PLOT.0, PLOT.1), (PLOT.2, PLOT.3))
}

/// A number over the input; the input is named where nothing below has the same axis.
fn over(notation: &Notation<'_>, seen: &Seen<'_>, panel: &Panel, last: bool) -> Group {
    let (sweep, columns) = (seen.sweep, panel.columns());
    let Some(column) = columns.first().map(|&c| &sweep.columns[c]) else { return Group::default() };
    let unit = &column.asked.unit;
    let input = input_unit(notation, sweep);
    let mut group = Group::new("over").data("quantity", &column.asked.name);
    // An angle that passes half a turn goes on.
    let turns = matches!(column.asked.quantity, Quantity::Angle(_));
    let middle = turns.then(|| angle_of_first(seen, panel)).flatten();
    let read = |values: &[Option<Dual>]| -> Option<Rate> {
        let (value, change) = panel.number(values)?;
        let value = middle.map_or(value, |m| value - 2.0 * PI * ((value - m) / (2.0 * PI)).round());
        Some((value / unit.si, change / unit.si))
    };
    let mut y = bounds(seen.looks(columns).iter().filter_map(|values| read(values).map(|r| r.0)));
    let noise = NOISE * error(seen, columns) / unit.si;
    // Between the places that were looked at there is what a cubic makes of them.
    let [low, high] = bounds(seen.tables.iter().flat_map(Table::places).filter_map(&read).map(|r| r.0));
    let constant = high - low < noise;
    if constant {
        // Wide enough for its ticks to have different numbers.
        let half = noise.max(y[1].abs() / 4.0);
        y = [y[0] - half, y[1] + half];
    }
    if panel.is_length() {
        y[0] = 0.0;
    }
    let blank = (y[1] - y[0]).max(y[1].abs() * 1e-6).max(f64::MIN_POSITIVE) * 0.04;
    let axes = Axes {
        plot: plot_area(),
        x: sweep.range.map(|x| x / input.si),
        y: [if panel.is_length() { 0.0 } else { y[0] - blank }, y[1] + blank],
    };
    let marks = match sweep.input {
        InputKind::Angle(_) => {
            let step = if axes.x[1] - axes.x[0] > 180.0 { 60.0 } else { 30.0 };
            let first = (axes.x[0] / step).ceil();
            let round: Vec<f64> =
                (0..13).map(|i| (first + f64::from(i)) * step).filter(|x| *x <= axes.x[1] + 1e-9).collect();
            if round.len() > 2 { round } else { ticks(axes.x[0], axes.x[1]) }
        }
        InputKind::Slide(_) | InputKind::Time => ticks(axes.x[0], axes.x[1]),
    };
    axes.draw(&mut group, &marks, last);
    let scale = axes.scale();
    let track = |at: f64, values: &[Option<Dual>]| {
        let (value, change) = read(values)?;
        // The slope of a constant is rounding.
        let change = if constant { 0.0 } else { change };
        let p = axes.map(at / input.si, value);
        Some((p, Vec2::new(scale.x / input.si, scale.y * change)))
    };
    for (stretch, table) in sweep.stretches.iter().zip(&seen.tables) {
        let visible = |values: &[Option<Dual>]| {
            is_sure(values, columns, (axes.y[1] - axes.y[0]) * unit.si)
                && read(values).is_some_and(|r| (axes.y[0]..=axes.y[1]).contains(&r.0))
        };
        for range in inside(sweep, (stretch, table), columns, visible) {
            let path = curve(sweep, table, columns, range, &track);
            group.mark(Mark::stroke(Shape::Curve(path), Pen::solid(THICK * 0.8)).class("curve"));
        }
    }
    if !last {
        return group;
    }
    let below = with_unit(notation, input_symbol(notation, sweep), &input).set(TICK);
    below.put(&mut group, Point::new(PLOT.0 + PLOT.2 - below.width, PLOT.1 + PLOT.3 + 8.0), "axis-name");
    group
}

/// The curve of a part of a stretch.
fn curve(sweep: &Sweep, table: &Table, columns: &[usize], range: [f64; 2], track: &Track<'_>) -> BezPath {
    let of_forces = columns.iter().any(|&c| matches!(sweep.columns[c].asked.quantity, Quantity::Force(..)));
    if of_forces {
        table.strokes(columns, range, track)
    } else {
        table.curve(columns, range, track, ACCURACY)
    }
}

/// A constant is drawn as one: its axis shows no less than this many times the numbers' errors.
const NOISE: f64 = 1e6;

/// The middle error of the columns over the sweep, SI units.
fn error(seen: &Seen<'_>, columns: &[usize]) -> f64 {
    let mut errors: Vec<f64> = seen
        .looks(columns)
        .into_iter()
        .flat_map(|values| columns.iter().filter_map(|&c| values[c]).map(|m| m.error).collect::<Vec<_>>())
        .collect();
    errors.sort_by(f64::total_cmp);
    errors.get(errors.len() / 2).copied().unwrap_or(0.0)
}

/// Whether numbers are known well enough to draw a curve through: beside a change point they fade into
/// rounding.
fn is_sure(values: &[Option<Dual>], columns: &[usize], span: f64) -> bool {
    const PART: f64 = 1e-4;
    columns.iter().all(|&c| values[c].is_some_and(|m| m.error <= PART * span))
}

/// The first value of an angle, to follow it over half a turn.
fn angle_of_first(seen: &Seen<'_>, panel: &Panel) -> Option<f64> {
    let looks = seen.looks(panel.columns());
    let values = looks.iter().filter_map(|values| panel.number(values).map(|r| r.0));
    // The middle of the circle's part that is used: opposite the widest gap.
    let mut sorted: Vec<f64> = values.map(|value| value - 2.0 * PI * (value / (2.0 * PI)).round()).collect();
    sorted.sort_by(f64::total_cmp);
    let first = *sorted.first()?;
    let gaps = sorted.windows(2).map(|w| (w[1] - w[0], f64::midpoint(w[0], w[1])));
    let last = (first + 2.0 * PI - sorted.last()?, first - (first + 2.0 * PI - sorted.last()?) / 2.0);
    let widest = gaps.chain([last]).max_by(|a, b| a.0.total_cmp(&b.0))?;
    Some(widest.1 + PI)
}

/// The parts of a stretch in which a condition holds, by halving.
fn inside(
    sweep: &Sweep,
    (stretch, table): (&Stretch, &Table),
    columns: &[usize],
    holds: impl Fn(&[Option<Dual>]) -> bool,
) -> Vec<[f64; 2]> {
    let look = |at: f64| holds(&table.at(at, columns));
    let looks = sweep.looks() / 2;
    let step = (stretch.to - stretch.from) / f64::from(looks);
    let edge = |mut out: f64, mut within: f64| {
        for _ in 0..40 {
            let middle = f64::midpoint(out, within);
            if look(middle) { within = middle } else { out = middle }
        }
        within
    };
    let mut parts = Vec::new();
    let mut open: Option<f64> = None;
    let mut last = stretch.from;
    for i in 0..=looks {
        // The ends themselves may have no number; a hair's breadth beside them there is one.
        let hair = step * 1e-6;
        let at = (stretch.from + step * f64::from(i)).clamp(stretch.from + hair, stretch.to - hair);
        match (open, look(at)) {
            (None, true) => open = Some(if i == 0 { at } else { edge(last, at) }),
            (Some(from), false) => {
                parts.push([from, edge(at, last)]);
                open = None;
            }
            _ => {}
        }
        last = at;
    }
    parts.extend(open.map(|from| [from, last]));
    parts.retain(|[a, b]| b > a);
    parts
}

/// The numbered positions: equal steps of what is varied.
fn numbered(sweep: &Sweep) -> impl Iterator<Item = (u32, f64)> {
    let step = (sweep.range[1] - sweep.range[0]) / f64::from(NUMBERED);
    (0..NUMBERED).map(move |i| (i, sweep.range[0] + step * f64::from(i)))
}

/// A path or a hodograph, with numbered positions.
fn plane(seen: &Seen<'_>, columns: [usize; 2]) -> Group {
    let sweep = seen.sweep;
    let column = &sweep.columns[columns[0]];
    let unit = &column.asked.unit;
    let path = is_place(column.asked.quantity);
    let mut group = Group::new(if path { "path" } else { "hodograph" }).data("quantity", &column.asked.name);
    let read = |values: &[Option<Dual>]| -> Option<[Rate; 2]> {
        let get = |c: usize| values.get(c).copied().flatten().map(|m| (m.value / unit.si, m.slope / unit.si));
        Some([get(columns[0])?, get(columns[1])?])
    };
    let looks = seen.looks(&columns);
    let points: Vec<[f64; 2]> =
        looks.iter().filter_map(|values| read(values).map(|r| r.map(|v| v.0))).collect();
    let mut limits = [0, 1].map(|axis| bounds(points.iter().map(|p| p[axis])));
    if !path {
        limits = limits.map(|[low, high]| [low.min(0.0), high.max(0.0)]);
    }
    let noise = NOISE * error(seen, &columns) / unit.si;
    limits =
        limits.map(|[low, high]| if high - low < noise { [low - noise, high + noise] } else { [low, high] });
    // One scale for both axes.
    let area = plot_area();
    let sizes = limits.map(|[low, high]| high - low);
    let per_mm = (sizes[0] / area.width()).max(sizes[1] / area.height()).max(f64::MIN_POSITIVE) * 1.12;
    let spans = [area.width() * per_mm, area.height() * per_mm];
    let [x, y] = [0, 1].map(|axis| {
        let middle = f64::midpoint(limits[axis][0], limits[axis][1]);
        [middle - spans[axis] / 2.0, middle + spans[axis] / 2.0]
    });
    let axes = Axes { plot: area, x, y };
    axes.draw(&mut group, &ticks(x[0], x[1]), true);
    let scale = axes.scale();
    let track = |_: f64, values: &[Option<Dual>]| {
        let [x, y] = read(values)?;
        Some((axes.map(x.0, y.0), Vec2::new(scale.x * x.1, scale.y * y.1)))
    };
    for (stretch, table) in sweep.stretches.iter().zip(&seen.tables) {
        let visible = |values: &[Option<Dual>]| {
            is_sure(values, &columns, (axes.x[1] - axes.x[0]) * unit.si)
                && read(values).is_some_and(|[x, y]| {
                    (axes.x[0]..=axes.x[1]).contains(&x.0) && (axes.y[0]..=axes.y[1]).contains(&y.0)
                })
        };
        for range in inside(sweep, (stretch, table), &columns, visible) {
            let path = curve(sweep, table, &columns, range, &track);
            group.mark(Mark::stroke(Shape::Curve(path), Pen::solid(THICK * 0.8)).class("curve"));
        }
    }
    let mut requests = Vec::new();
    if !path {
        let pole = axes.map(0.0, 0.0);
        group.mark(dot(pole, 0.6).class("pole"));
        let site = Site::Around { at: pole, radius: 0.8, toward: None };
        requests.push(Request::new(Rich::italic("o"), SMALL, site, "pole"));
    }
    for (i, at) in numbered(sweep) {
        let Some([x, y]) = seen.at(at, &columns).and_then(|values| read(&values)) else { continue };
        let place = axes.map(x.0, y.0);
        if !area.contains(place) {
            continue;
        }
        group.mark(dot(place, 0.5).class("position"));
        let site = Site::Around { at: place, radius: 0.7, toward: None };
        let mut request = Request::new(Rich::upright(i.to_string()), TICK, site, "position");
        request.optional = true;
        requests.push(request);
    }
    let names = labels::place(&group, &requests, Some(area.inflate(4.0, 4.0)));
    group.group(names);
    group
}

/// From spoke to spoke of a polar diagram, degrees.
const SPOKE: u32 = 30;

/// The length of a vector, laid off in the direction of the input: circles for its size, spokes for the input, a
/// dot at every numbered position.
fn polar(seen: &Seen<'_>, columns: [usize; 2]) -> Group {
    let sweep = seen.sweep;
    let column = &sweep.columns[columns[0]];
    let unit = &column.asked.unit;
    let mut group = Group::new("polar").data("quantity", &column.asked.name);
    let panel = Panel::Polar(columns);
    let read = |values: &[Option<Dual>]| -> Option<Rate> {
        panel.number(values).map(|(value, change)| (value / unit.si, change / unit.si))
    };
    let looks = seen.looks(&columns);
    let [_, most] = bounds(looks.iter().filter_map(|values| read(values).map(|r| r.0)));
    let most = most.max(f64::MIN_POSITIVE);
    let area = plot_area();
    let (pole, radius) = (area.center(), area.height() / 2.0 - 2.0);
    let per_unit = radius / (most * 1.02);
    let at = |angle: f64, size: f64| {
        let (sin, cos) = libm::sincos(angle);
        pole + Vec2::new(cos, -sin) * size
    };
    let circles: Vec<f64> = ticks(0.0, most).into_iter().filter(|size| *size > 0.0).collect();
    for &size in &circles {
        let shape = Shape::Circle { centre: pole, radius: size * per_unit };
        group.mark(Mark::stroke(shape, Pen::solid(FINE)).class("tick"));
    }
    for spoke in 0..360 / SPOKE {
        let angle = f64::from(spoke * SPOKE).to_radians();
        let line = Shape::Line(pole, at(angle, radius));
        group.mark(Mark::stroke(line, Pen::solid(FINE)).class("tick"));
        let text = human::degrees(angle).set(TICK);
        let (sin, cos) = libm::sincos(angle);
        // Centred on the spoke's end, as far out as the text is wide or high.
        let out = radius + 2.2 + (cos.abs() * text.width + sin.abs() * 2.0) / 2.0;
        text.put(&mut group, at(angle, out) + Vec2::new(-text.width / 2.0, 0.9), "tick");
    }
    let track = |input: f64, values: &[Option<Dual>]| {
        let (value, change) = read(values)?;
        let (sin, cos) = libm::sincos(input);
        let (out, round) = (Vec2::new(cos, -sin), Vec2::new(-sin, -cos));
        Some((pole + out * (value * per_unit), (out * change + round * value) * per_unit))
    };
    for (stretch, table) in sweep.stretches.iter().zip(&seen.tables) {
        let visible = |values: &[Option<Dual>]| {
            is_sure(values, &columns, most * unit.si) && read(values).is_some_and(|r| r.0 <= most)
        };
        for range in inside(sweep, (stretch, table), &columns, visible) {
            let path = curve(sweep, table, &columns, range, &track);
            group.mark(Mark::stroke(Shape::Curve(path), Pen::solid(THICK * 0.8)).class("curve"));
        }
    }
    let mut requests = Vec::new();
    for (i, place) in numbered(sweep) {
        let Some((value, _)) = seen.at(place, &columns).and_then(|values| read(&values)) else { continue };
        if value > most {
            continue;
        }
        let dotted = at(place, value * per_unit);
        group.mark(dot(dotted, 0.5).class("position"));
        let site = Site::Around { at: dotted, radius: 0.7, toward: None };
        let mut request = Request::new(Rich::upright(i.to_string()), TICK, site, "position");
        request.optional = true;
        requests.push(request);
    }
    // The sizes of the circles, where there is room on them.
    for &size in &circles {
        let site = Site::Around { at: at(PI / 12.0, size * per_unit), radius: 0.2, toward: None };
        let mut request = Request::new(human::stated(size), TICK, site, "size");
        request.optional = true;
        requests.push(request);
    }
    let names = labels::place(&group, &requests, Some(area.inflate(4.0, 4.0)));
    group.group(names);
    group
}
