//! The course of a mechanism over its input: where it goes, where it stops, what is extreme on the way.

use std::f64::consts::PI;

use super::{Column, InputKind, Sweep};
use crate::board::{Moving, Place, Reason};
use crate::mechanism::quantity::Quantity;

/// A range of the input in which the mechanism moves freely in one assembly.
#[derive(Debug, Clone, PartialEq)]
pub struct Stretch {
    /// Where it begins, SI units.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// The sign of every half chord against the transcribed drawing.
    pub signs: Vec<f64>,
    /// The input cannot get here from the scene's own position without taking the mechanism apart.
    pub apart: bool,
}

/// What happens at a place of the input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum EventKind {
    /// Two arcs just touch: the input goes no further.
    Limit,
    /// Two arcs touch and come apart again: the assemblies meet here.
    ChangePoint,
    /// A divisor vanishes: speeds are not determined by the input.
    DeadPosition,
    /// An instant centre is at infinity: its lines are parallel.
    AtInfinity {
        /// Index of the first of its columns.
        column: usize,
    },
    /// A column has its least value for the neighbourhood.
    Least {
        /// Index of the column.
        column: usize,
        /// Its value, SI units.
        value: f64,
    },
    /// A column has its greatest value for the neighbourhood.
    Greatest {
        /// Index of the column.
        column: usize,
        /// Its value, SI units.
        value: f64,
    },
}

/// Something that happens at a place of the input.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Event {
    /// The input, SI units.
    pub at: f64,
    /// What.
    pub kind: EventKind,
    /// Which links are to blame, where some are.
    pub reason: Option<Reason>,
}

/// A number is taken for zero within so many of its own errors: by as much as the tape wants a divisor to
/// stand clear.
const ERRORS: f64 = 8.0;

/// Whether a number stands clear of its own rounding.
pub(super) fn is_clear(m: Moving) -> bool {
    m.value.abs() > ERRORS * m.error
}

/// Halves an interval down to a rounding of `size`: the last place where `left` still holds, and the first
/// where it does not.
fn halve(size: f64, mut low: f64, mut high: f64, mut left: impl FnMut(f64) -> bool) -> (f64, f64) {
    loop {
        let middle = f64::midpoint(low, high);
        if (high - low).abs() <= f64::EPSILON / 2.0 * size || middle == low || middle == high {
            return (low, high);
        }
        if left(middle) { low = middle } else { high = middle }
    }
}

/// At an extreme found to the last place, what is left of the slope is below this part of the slopes on
/// either side.
const STILL: f64 = 1e-6;

/// An angle that is so far from the half turns it is measured from is measured from the next ones.
const FAR: f64 = 0.75 * PI;

struct Walker<'s> {
    sweep: &'s Sweep,
    place: Place,
}

/// What a walker sees at one place.
struct View {
    at: f64,
    chords: Vec<Moving>,
    divisors: Vec<Moving>,
    columns: Vec<Moving>,
    /// Angles that go on, from the half turns that they are near.
    turns: Vec<f64>,
}

impl View {
    /// No two arcs just touch.
    fn is_clear(&self) -> bool {
        self.chords.iter().all(|c| is_clear(*c))
    }

    /// Every half chord can be drawn, or just.
    fn closes(&self) -> bool {
        self.chords.iter().all(|c| c.value > -ERRORS * c.error)
    }
}

impl Walker<'_> {
    fn view(&mut self, at: f64, signs: &[f64]) -> View {
        let program = &self.sweep.transcribed().program;
        program.look(at, signs, &mut self.place);
        View {
            turns: program.turns(&self.place, signs).collect(),
            at,
            chords: program.chords(&self.place).collect(),
            divisors: program.divisors(&self.place).collect(),
            columns: program
                .asked(&self.place)
                .zip(&self.sweep.columns)
                .map(|(m, column)| column.counted(m))
                .collect(),
        }
    }

    /// A stretch from `start` in one direction: until the chain no longer closes or the range ends. Gives
    /// the stretches in walking order and what happened.
    fn go(
        &mut self,
        nodes: &[f64],
        mut signs: Vec<f64>,
        stretches: &mut Vec<Stretch>,
        events: &mut Vec<Event>,
    ) {
        let Some(&start) = nodes.first() else { return };
        let size = self.sweep.size();
        let mut before = self.view(start, &signs);
        let mut begin = start;
        let mut apart = false;
        let mut inside = before.closes();
        let mut close = |a: f64, b: f64, signs: &[f64], apart: bool| {
            let (from, to) = (a.min(b), a.max(b));
            // What is shorter than the input's own rounding is nothing.
            if to - from > seam(self.sweep) {
                stretches.push(Stretch { from, to, signs: signs.to_vec(), apart });
            }
        };
        for &next in &nodes[1..] {
            let mut now = self.view(next, &signs);
            if !inside {
                if now.closes() {
                    let (_, edge) = halve(size, before.at, next, |x| !self.view(x, &signs).closes());
                    events.push(self.limit(edge, &signs));
                    (begin, inside, apart) = (edge, true, true);
                }
                before = now;
                continue;
            }
            // A half chord that shrinks and grows again may touch zero on the way.
            let direction = (next - before.at).signum();
            let mut touched = false;
            for chord in 0..now.chords.len() {
                let (a, b) = (before.chords[chord], now.chords[chord]);
                if !(a.slope * direction < 0.0 && b.slope * direction >= 0.0) {
                    continue;
                }
                let (low, _) = halve(size, before.at, next, |x| {
                    self.view(x, &signs).chords[chord].slope * direction < 0.0
                });
                let least = self.view(low, &signs).chords[chord];
                if is_clear(least) && least.value > 0.0 {
                    continue;
                }
                if is_clear(least) {
                    // It passes below zero and comes back between two looks.
                    let (end, _) = halve(size, before.at, low, |x| self.view(x, &signs).closes());
                    close(begin, end, &signs, apart);
                    events.push(self.limit(end, &signs));
                    if self.sweep.input == InputKind::Time {
                        return;
                    }
                    let (_, edge) = halve(size, low, next, |x| !self.view(x, &signs).closes());
                    events.push(self.limit(edge, &signs));
                    (begin, apart) = (edge, true);
                    continue;
                }
                close(begin, low, &signs, apart);
                events.push(Event {
                    at: low,
                    kind: EventKind::ChangePoint,
                    reason: self.sweep.transcribed().program.reason_of_chord(chord),
                });
                begin = low;
                signs[chord] = -signs[chord];
                touched = true;
            }
            // An angle that comes near to half a turn more, or less, is measured from there, well before it could be
            // taken for another.
            let mut turned = false;
            for turn in 0..now.turns.len() {
                let side = now.turns[turn].signum();
                if now.turns[turn].abs() <= FAR {
                    continue;
                }
                let (low, _) =
                    halve(size, before.at, next, |x| self.view(x, &signs).turns[turn].abs() <= FAR);
                close(begin, low, &signs, apart);
                begin = low;
                signs[now.chords.len() + turn] += side;
                turned = true;
            }
            if touched || turned {
                now = self.view(next, &signs);
            }
            if now.closes() {
                if !touched {
                    self.dead_positions(&before, &now, &signs, events);
                    self.extremes(&before, &now, &signs, events);
                }
            } else {
                let (end, _) = halve(size, before.at, next, |x| self.view(x, &signs).closes());
                close(begin, end, &signs, apart);
                events.push(self.limit(end, &signs));
                inside = false;
                if self.sweep.input == InputKind::Time {
                    // What drives it has come to a stop.
                    return;
                }
            }
            before = now;
        }
        if inside {
            close(begin, before.at, &signs, apart);
        }
    }

    fn limit(&mut self, at: f64, signs: &[f64]) -> Event {
        let view = self.view(at, signs);
        let nearest = (0..view.chords.len()).min_by(|&a, &b| {
            let part = |c: Moving| c.value.abs() / c.slope.abs().max(f64::MIN_POSITIVE);
            part(view.chords[a]).total_cmp(&part(view.chords[b]))
        });
        let reason = nearest.and_then(|chord| self.sweep.transcribed().program.reason_of_chord(chord));
        Event { at, kind: EventKind::Limit, reason }
    }

    /// Divisors, other than half chords, that pass zero.
    fn dead_positions(&mut self, before: &View, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        let size = self.sweep.size();
        for index in 0..now.divisors.len() {
            let (a, b) = (before.divisors[index].value, now.divisors[index].value);
            if (a < 0.0) == (b < 0.0) || self.sweep.transcribed().program.is_chord(index) {
                continue;
            }
            let (at, _) = halve(size, before.at, now.at, |x| {
                (self.view(x, signs).divisors[index].value < 0.0) == (a < 0.0)
            });
            // A pole changes its sign as well, but does not vanish.
            let view = self.view(at, signs);
            let there = view.divisors[index].value.abs();
            if !(there < a.abs().max(b.abs()) && view.is_clear()) {
                continue;
            }
            let reason = self.sweep.transcribed().program.reason_of_divisor(index);
            match self.centre_of(index) {
                None => events.push(Event { at, kind: EventKind::DeadPosition, reason }),
                Some(column) => {
                    // Other divisors on the way to a centre vanish where two of its lines become one: nothing happens
                    // to the mechanism there.
                    let far =
                        |view: &View| view.columns[column].value.abs() + view.columns[column + 1].value.abs();
                    if far(&view) > far(before) && far(&view) > far(now) {
                        events.push(Event { at, kind: EventKind::AtInfinity { column }, reason: None });
                    }
                }
            }
        }
    }

    /// The first column of the only centre that a divisor leads to; `None` where it leads to anything else.
    fn centre_of(&self, divisor: usize) -> Option<usize> {
        let program = &self.sweep.transcribed().program;
        let columns = &self.sweep.columns;
        let mut led_to = (0..columns.len()).filter(|&column| program.behind(column).contains(&divisor));
        let first = led_to.next()?;
        let only = columns[first].is_centre()
            && led_to.all(|column| columns[column].asked.quantity == columns[first].asked.quantity);
        only.then_some(first)
    }

    fn extremes(&mut self, before: &View, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        let size = self.sweep.size();
        for index in 0..now.columns.len() {
            let (a, b) = (before.columns[index], now.columns[index]);
            if (a.slope < 0.0) == (b.slope < 0.0) || !is_extreme_of_interest(&self.sweep.columns[index]) {
                continue;
            }
            // A slope of rounding only is no extreme.
            let still = |m: Moving| (m.slope * (now.at - before.at)).abs() <= ERRORS * m.error;
            if still(a) && still(b) {
                continue;
            }
            let (at, _) = halve(size, before.at, now.at, |x| {
                (self.view(x, signs).columns[index].slope < 0.0) == (a.slope < 0.0)
            });
            let view = self.view(at, signs);
            let value = view.columns[index].value;
            let ascending = now.at > before.at;
            // Where the walk begins on the extreme itself its slope is zero: what comes after tells which it is.
            let beyond = (a.slope < 0.0) != ascending;
            // Where a slope jumps, or passes through infinity, nothing is extreme.
            let vanishes = view.columns[index].slope.abs() <= STILL * a.slope.abs().max(b.slope.abs());
            let near = value.is_finite() && vanishes && view.is_clear();
            if near {
                let kind = if beyond {
                    EventKind::Greatest { column: index, value }
                } else {
                    EventKind::Least { column: index, value }
                };
                events.push(Event { at, kind, reason: None });
            }
        }
    }
}

/// Scalars, and the coordinates of places.
fn is_extreme_of_interest(column: &Column) -> bool {
    column.axis.is_none() || matches!(column.asked.quantity, Quantity::Position(_))
}

/// Walks the whole range from the start, up and down.
pub(super) fn walk(sweep: &Sweep, start: f64, looks: u32) -> (Vec<Stretch>, Vec<Event>) {
    let [from, to] = sweep.range;
    let signs = sweep.transcribed().program.signs();
    let go = |end: f64| {
        let (mut stretches, mut events) = (Vec::new(), Vec::new());
        let mut walker = Walker { sweep, place: Place::default() };
        walker.go(&nodes(start, end, looks, to - from), signs.clone(), &mut stretches, &mut events);
        (stretches, events)
    };
    let (mut stretches, mut events);
    if sweep.whole_turn && sweep.input == InputKind::Time {
        // A period, from its beginning.
        (stretches, events) = go(to);
    } else if sweep.whole_turn {
        // Once round. Where the way up ends, the way down may still lead on, past the zero of the turn.
        (stretches, events) = go(start + (to - from));
        if stretches.iter().any(|s| s.apart) || stretches.last().is_none_or(|s| s.to < start + (to - from)) {
            let (down, on_the_way) = go(start - (to - from));
            let reached = down.iter().filter(|s| !s.apart).map(|s| s.from).fold(start, f64::min);
            let above = |x: f64| x < reached + (to - from) - seam(sweep);
            stretches.retain(|s| !s.apart || above(s.to));
            stretches.extend(down.into_iter().filter(|s| !s.apart));
            events.retain(|e| above(e.at));
            events.extend(on_the_way.into_iter().filter(|e| e.at >= reached));
        }
        (stretches, events) = wrapped(stretches, events, sweep.range, seam(sweep));
    } else {
        let (up, down);
        (up, events) = go(to);
        let below;
        (down, below) = go(from);
        events.extend(below);
        stretches = down;
        stretches.extend(up);
    }
    if sweep.whole_turn {
        extremes_at_the_seam(sweep, start, looks, &stretches, &mut events);
    }
    stretches.sort_by(|a, b| a.from.total_cmp(&b.from));
    stretches.dedup_by(|next, last| {
        let one = (last.to - next.from).abs() <= seam(sweep)
            && last.signs == next.signs
            && last.apart == next.apart;
        if one {
            last.to = next.to;
        }
        one
    });
    events.sort_by(|a, b| a.at.total_cmp(&b.at));
    (stretches, events)
}

/// What is extreme just where the turn begins and ends has a slope of rounding at both ends of the walk: a look
/// across finds it.
fn extremes_at_the_seam(
    sweep: &Sweep,
    start: f64,
    looks: u32,
    stretches: &[Stretch],
    events: &mut Vec<Event>,
) {
    let turn = sweep.range[1] - sweep.range[0];
    let half = turn / f64::from(looks) / 2.0;
    let home = |x: f64| {
        let inside = x - turn * ((x - sweep.range[0]) / turn).floor();
        if sweep.range[1] - inside < seam(sweep) { sweep.range[0] } else { inside }
    };
    let here = |x: f64| stretches.iter().find(|s| (s.from..=s.to).contains(&home(x)) && !s.apart);
    let [Some(before), Some(after)] = [here(start - half), here(start + half)] else { return };
    if before.signs != after.signs {
        return;
    }
    let mut walker = Walker { sweep, place: Place::default() };
    let mut found = Vec::new();
    walker.go(&[start - half, start + half], before.signs.clone(), &mut Vec::new(), &mut found);
    for event in found {
        let (EventKind::Least { column, .. } | EventKind::Greatest { column, .. }) = event.kind else {
            // Whatever else happens here was met on the way.
            continue;
        };
        let same = |other: &Event| match other.kind {
            EventKind::Least { column: of, .. } => {
                of == column && matches!(event.kind, EventKind::Least { .. })
            }
            EventKind::Greatest { column: of, .. } => {
                of == column && matches!(event.kind, EventKind::Greatest { .. })
            }
            _ => false,
        };
        let apart = |other: &Event| {
            let way = (other.at - home(event.at)).abs();
            way.min(turn - way)
        };
        if !events.iter().any(|other| same(other) && apart(other) < 2.0 * half) {
            events.push(Event { at: home(event.at), ..event });
        }
    }
}

/// Places to look at, from `a` to `b`.
fn nodes(a: f64, b: f64, looks: u32, whole: f64) -> Vec<f64> {
    if a == b {
        return Vec::new();
    }
    let count = (f64::from(looks) * ((b - a) / whole).abs()).ceil().max(1.0);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "1 to the looks of the sweep"
    )]
    let count = count as u32;
    (0..=count)
        .map(|i| if i == count { b } else { a + (b - a) * (f64::from(i) / f64::from(count)) })
        .collect()
}

/// Places of the input that are apart by less are one: their difference is rounding.
fn seam(sweep: &Sweep) -> f64 {
    ERRORS * f64::EPSILON * sweep.size()
}

/// Brings what was met on the way round into one turn.
fn wrapped(
    stretches: Vec<Stretch>,
    events: Vec<Event>,
    [from, to]: [f64; 2],
    seam: f64,
) -> (Vec<Stretch>, Vec<Event>) {
    let turn = to - from;
    let home = |x: f64| {
        let inside = x - turn * ((x - from) / turn).floor();
        if inside - from < seam || to - inside < seam { from } else { inside }
    };
    let mut cut = Vec::new();
    for stretch in stretches {
        let begin = home(stretch.from);
        let end = begin + (stretch.to - stretch.from);
        if end > to + seam {
            cut.push(Stretch { from: begin, to, ..stretch.clone() });
            cut.push(Stretch { from, to: end - turn, ..stretch });
        } else {
            cut.push(Stretch { from: begin, to: if to - end < seam { to } else { end }, ..stretch });
        }
    }
    let mut events: Vec<Event> = events.into_iter().map(|e| Event { at: home(e.at), ..e }).collect();
    events.sort_by(|a, b| a.at.total_cmp(&b.at));
    (cut, events)
}
