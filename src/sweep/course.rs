//! The course of a mechanism over its input: where it goes, where it stops, what is extreme on the way.

use std::f64::consts::PI;

use super::{InputKind, Measure, Sweep};
use crate::board::{Dual, LookedFor, Moving, Reason, Standing, Workspace};

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
        /// Index of the centre among [`Sweep::centres`].
        centre: usize,
        /// In which direction, radians from the x-axis in [0, π).
        direction: f64,
    },
    /// A quantity has its least value for the neighbourhood: a scalar, a coordinate of a place, the magnitude of any
    /// other vector. Of a force that leaps there it is that of the lower side ([`Sweep::reversals`]).
    Least {
        /// Index of the column; of a magnitude the first of its two.
        column: usize,
        /// Its value, SI units.
        value: f64,
    },
    /// A quantity has its greatest value for the neighbourhood; of a force that leaps there that of the higher side.
    Greatest {
        /// Index of the column; of a magnitude the first of its two.
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
pub(super) const ERRORS: f64 = 8.0;

/// Whether a number exceeds its own rounding.
pub(super) fn is_clear(m: Dual) -> bool {
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

/// Where a number changes its sign, to a rounding of `size`: the last place found with the sign that it has at `from`.
/// Regula falsi with the Illinois step (Dowell and Jarratt 1971), every third step a halving, so that it ends after
/// [`MOST_TRIES`] looks whatever the number does; a smooth one takes some twenty.
fn root(size: f64, from: (f64, f64), to: (f64, f64), mut value: impl FnMut(f64) -> f64) -> f64 {
    let ((mut a, mut f), (mut b, mut g)) = (from, to);
    let negative = f < 0.0;
    let finest = f64::EPSILON / 2.0 * size;
    for tries in 0..MOST_TRIES {
        let way = b - a;
        if way.abs() <= finest {
            break;
        }
        let part = f / (f - g);
        let middle = if tries % 3 == 2 || !part.is_finite() { 0.5 } else { part };
        // Not nearer to either end than the finest step: then the end itself closes in.
        let least = (finest / way.abs()).min(0.5);
        let x = a + way * middle.clamp(least, 1.0 - least);
        if x == a || x == b {
            break;
        }
        let h = value(x);
        // Beyond the end of a chain there are no numbers: that is the other side.
        if h.is_finite() && (h < 0.0) == negative {
            (a, f) = (x, h);
            g /= 2.0;
        } else {
            (b, g) = (x, h);
            f /= 2.0;
        }
    }
    a
}

/// A search for one root looks at no more places: a halving among every three down to a rounding.
const MOST_TRIES: u32 = 180;

/// At an extreme found to the last place, what is left of the slope is below this part of the slopes on
/// either side.
const STILL: f64 = 1e-6;

/// An angle that is so far from the half turns it is measured from is measured from the next ones.
const FAR: f64 = 0.75 * PI;

/// What is tried and strays farther from where it is expected is expected anew, in parts of how far it may go at once.
const ASTRAY: f64 = 0.05;

/// What strays so far has become another root.
const FAR_ASTRAY: f64 = 0.5;

/// This part of the way to the next look.
const A_LITTLE: f64 = 1e-6;

/// Where something is tried, the square of a half chord that may vanish here, in square millimetres.
const SHORT: f64 = 1e-2;

/// What is tried is expected anew so often between two looks at most.
const MOST_TRIALS: u32 = 64;

/// A dead position that is so near to a limit of what is tried, in parts of the input's size, is that limit: two roots
/// become one there, and each is known to half its digits only.
const AT_LIMIT: f64 = 1e-10;

struct Walker<'s> {
    sweep: &'s Sweep,
    place: Workspace,
    /// Where each divisor was last clear of its error in this assembly, and what it was there.
    divisors: Vec<Option<(f64, f64)>>,
    /// The same of the weights of the centres.
    weights: Vec<Option<(f64, f64)>>,
}

/// Where a half chord inside a trial passes zero.
struct Crossing {
    /// Its place among the signs.
    index: usize,
    /// Where, by what is seen on this side.
    at: f64,
    /// How fast it changes with its sign.
    rate: f64,
    /// The last that was seen on this side, where that is not the last look.
    seen: Option<View>,
}

/// What a walker sees at one place.
struct View {
    at: f64,
    /// Squares of half chords, with their place among the signs.
    chords: Vec<(usize, Dual)>,
    divisors: Vec<Dual>,
    columns: Vec<Dual>,
    /// Reach and weight of every centre.
    centres: Vec<[Dual; 3]>,
    /// Angles that go on, from the half turns that they are near, with their place among the signs.
    turns: Vec<(usize, f64)>,
    /// What is found by trial.
    standing: Vec<Standing>,
}

impl View {
    /// No two arcs just touch.
    fn is_clear(&self) -> bool {
        self.chords.iter().all(|(_, c)| is_clear(*c))
    }

    /// No two arcs come near to touching between here and another look at which they do not, seen from their tangents.
    fn stays_clear(&self, other: &Self) -> bool {
        /// So many times farther from touching than is told from it.
        const FARTHER: f64 = 16.0;
        let way = other.at - self.at;
        self.chords.iter().zip(&other.chords).all(|((_, a), (_, b))| {
            let [far_here, far_there] = [a, b].map(|c| c.value > FARTHER * ERRORS * c.error);
            let falls_and_rises = a.slope * way < 0.0 && b.slope * way > 0.0;
            far_here && far_there && !(falls_and_rises && may_touch(*a, *b, way))
        })
    }

    /// Every half chord can be drawn, or just, and what is tried has met its constraints.
    fn closes(&self) -> bool {
        self.chords.iter().all(|(_, c)| c.value > -ERRORS * c.error)
            && self.standing.iter().all(|trial| trial.at.value.is_finite())
    }

    /// What is tried stands near where it is expected: within so many of the lengths that it may go at once.
    fn is_expected(&self, within: f64) -> bool {
        // Written so that a not-a-number is not.
        self.standing.iter().all(|trial| trial.strayed <= within)
    }

    /// The chain closes, with what is tried near where it is expected.
    fn goes_on(&self, within: f64) -> bool {
        self.closes() && self.is_expected(within)
    }

    /// The signs with what is tried expected to move on as it does here.
    fn expecting(&self, signs: &[f64]) -> Vec<f64> {
        let mut signs = signs.to_vec();
        for trial in &self.standing {
            let rate = if trial.at.slope.is_finite() { trial.at.slope } else { 0.0 };
            if let Some(numbers) = signs.get_mut(trial.index..trial.index + 4) {
                numbers.copy_from_slice(&[self.at, trial.at.value, rate, trial.sense]);
            }
        }
        signs
    }

    /// How far a limit at this place may be off, as far as rounding tells: the place where the arcs just touch, and as
    /// much on its other side.
    fn blur(&self) -> f64 {
        let off = |c: &Dual| 2.0 * ERRORS * c.error / c.slope.abs();
        let touching = self.chords.iter().filter(|(_, c)| !is_clear(*c)).map(|(_, c)| off(c));
        touching.filter(|off| off.is_finite()).fold(0.0, f64::max)
    }

    /// What is measured, or its square where it is a magnitude: that has a slope where it is zero, too.
    fn measured(&self, measure: Measure) -> Dual {
        match measure {
            Measure::Column(column) => self.columns[column],
            Measure::Magnitude(columns) => square_of(columns.map(|column| self.columns[column])),
        }
    }
}

/// A number of which nobody asks how far rounding may have put it off.
fn unrounded(m: Moving) -> Dual {
    Dual { value: m.value, slope: m.slope, error: 0.0 }
}

/// The square of a vector's magnitude, from its coordinates.
fn square_of(coordinates: [Dual; 2]) -> Dual {
    let mut square = Dual::default();
    for m in coordinates {
        square.value += m.value * m.value;
        square.slope += 2.0 * m.value * m.slope;
        square.error += 2.0 * m.value.abs() * m.error + m.error * m.error;
    }
    square
}

/// Notes where a number is clear of its error; where it was last so, if it had the other sign there.
fn crossed(last: &mut Option<(f64, f64)>, at: f64, now: Dual) -> Option<(f64, f64)> {
    if !is_clear(now) {
        return None;
    }
    let before = last.replace((at, now.value))?;
    ((before.1 < 0.0) != (now.value < 0.0)).then_some(before)
}

/// Whether a number that falls from one look and rises to the next may come near zero in between, seen from its tangents:
/// their meet lies below a curve that bends upward.
fn may_touch(a: Dual, b: Dual, way: f64) -> bool {
    let (down, up) = (a.slope * way, b.slope * way);
    let meet = a.value + down * ((b.value - up - a.value) / (down - up)).clamp(0.0, 1.0);
    // Written so that a not-a-number is looked at.
    let stays_away = meet > 0.25 * a.value.min(b.value);
    !stays_away
}

impl Walker<'_> {
    fn new(sweep: &Sweep) -> Walker<'_> {
        Walker { sweep, place: Workspace::default(), divisors: Vec::new(), weights: Vec::new() }
    }

    fn view(&mut self, at: f64, signs: &[f64]) -> View {
        let program = &self.sweep.transcribed().program;
        program.look(at, signs, &mut self.place);
        let columns = self.sweep.columns.len();
        let mut asked = program.asked(&self.place);
        let counted = asked.by_ref().take(columns).zip(&self.sweep.columns);
        let counted = counted.map(|(m, column)| column.counted(m)).collect();
        let homogeneous: Vec<Dual> = asked.collect();
        View {
            turns: program.turns(&self.place, signs).collect(),
            standing: program.standing(&self.place, signs).collect(),
            at,
            chords: program.chords(&self.place).collect(),
            divisors: program.divisors(&self.place).collect(),
            columns: counted,
            centres: homogeneous.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
        }
    }

    /// Forgets where numbers were clear: from here on the mechanism is another.
    fn begin(&mut self, view: &View) {
        let seen = |m: Dual| is_clear(m).then_some((view.at, m.value));
        self.divisors = view.divisors.iter().map(|m| seen(*m)).collect();
        self.weights = view.centres.iter().map(|[.., weight]| seen(*weight)).collect();
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
        if inside {
            signs = before.expecting(&signs);
        }
        self.begin(&before);
        let mut close = |a: f64, b: f64, signs: &[f64], apart: bool| {
            let (from, to) = (a.min(b), a.max(b));
            // What is shorter than the input's own rounding is nothing.
            if to - from > seam(self.sweep) {
                stretches.push(Stretch { from, to, signs: signs.to_vec(), apart });
            }
        };
        for &next in &nodes[1..] {
            let step = next - before.at;
            if self.sweep.tries() && inside {
                // Another dyad's chord may vanish on the same way.
                while let Some(crossing) = self.crossing(&before, next, &signs) {
                    let Some((onward, there)) = self.beyond(&crossing, next, step, &signs) else { break };
                    if let Some(seen) = &crossing.seen {
                        self.events_between(&before, seen, &signs, events);
                    }
                    close(begin, crossing.at, &signs, apart);
                    (begin, signs) = (crossing.at, onward);
                    self.begin(&there);
                    before = there;
                }
                if (next - before.at) * (nodes[nodes.len() - 1] - start) <= 0.0 {
                    continue;
                }
            }
            let mut now = self.view(next, &signs);
            if !inside {
                if now.closes() {
                    let (_, edge) = halve(size, before.at, next, |x| !self.view(x, &signs).closes());
                    events.push(self.limit(edge, &signs));
                    (begin, inside, apart) = (edge, true, true);
                    self.begin(&now);
                }
                before = now;
                continue;
            }
            // What is tried is expected from where it was last seen; where it moves too fast to be found from there, on
            // the way.
            let mut from_here = false;
            for _ in 0..MOST_TRIALS {
                if !self.sweep.tries() || now.goes_on(if from_here { FAR_ASTRAY } else { ASTRAY }) {
                    break;
                }
                if from_here {
                    let seen = |x: f64| self.view(x, &signs).goes_on(FAR_ASTRAY);
                    let (seen, _) = halve(size, before.at, next, seen);
                    let on_the_way = self.view(seen, &signs);
                    self.events_between(&before, &on_the_way, &signs, events);
                    before = on_the_way;
                    // Where even a little farther nothing is found from there, it is a limit.
                    let onward = before.expecting(&signs);
                    let little = seen + A_LITTLE * (next - seen);
                    if !self.view(little, &onward).goes_on(FAR_ASTRAY) {
                        close(begin, seen, &signs, apart);
                        events.push(self.limit(seen, &signs));
                        return;
                    }
                }
                close(begin, before.at, &signs, apart);
                begin = before.at;
                signs = before.expecting(&signs);
                from_here = true;
                now = self.view(next, &signs);
            }
            // A half chord that shrinks and grows again may touch zero on the way.
            let direction = (next - before.at).signum();
            let mut touched = false;
            for chord in 0..now.chords.len() {
                let ((index, a), (_, b)) = (before.chords[chord], now.chords[chord]);
                if self.sweep.transcribed().program.is_of_trial(index) {
                    continue;
                }
                let falls_and_rises = a.slope * direction < 0.0 && b.slope * direction >= 0.0;
                if !(falls_and_rises && may_touch(a, b, next - before.at)) {
                    continue;
                }
                // What is still, as everything is beyond a limit, no longer falls.
                let low = root(size, (before.at, a.slope * direction), (next, b.slope * direction), |x| {
                    self.view(x, &signs).chords[chord].1.slope * direction
                });
                let least = self.view(low, &signs).chords[chord].1;
                if !least.value.is_finite() || is_clear(least) && least.value > 0.0 {
                    continue;
                }
                if is_clear(least) {
                    // It passes below zero and comes back between two looks.
                    let (end, _) = halve(size, before.at, low, |x| self.view(x, &signs).closes());
                    close(begin, end, &signs, apart);
                    events.push(self.limit(end, &signs));
                    if self.sweep.input == InputKind::Time || self.sweep.tries() {
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
                signs[index] = -signs[index];
                touched = true;
            }
            // An angle that comes near to half a turn more, or less, is measured from there, well before it could be
            // taken for another.
            let mut turned = false;
            for turn in 0..now.turns.len() {
                let (index, from_there) = now.turns[turn];
                if from_there.abs() <= FAR {
                    continue;
                }
                let (low, _) =
                    halve(size, before.at, next, |x| self.view(x, &signs).turns[turn].1.abs() <= FAR);
                close(begin, low, &signs, apart);
                begin = low;
                signs[index] += from_there.signum();
                turned = true;
            }
            if touched || turned {
                now = self.view(next, &signs);
            }
            if now.closes() {
                if touched {
                    self.begin(&now);
                } else {
                    self.events_between(&before, &now, &signs, events);
                }
            } else {
                let (end, _) = halve(size, before.at, next, |x| self.view(x, &signs).closes());
                close(begin, end, &signs, apart);
                events.push(self.limit(end, &signs));
                inside = false;
                if self.sweep.input == InputKind::Time || self.sweep.tries() {
                    // What drives it has come to a stop; or nobody knows where to look for what is tried beyond.
                    return;
                }
            }
            before = now;
        }
        if inside {
            close(begin, before.at, &signs, apart);
        }
    }

    /// Where the half chord of a dyad inside a trial, seen with its sign, passes zero before the next look.
    fn crossing(&mut self, before: &View, next: f64, signs: &[f64]) -> Option<Crossing> {
        let chords: Vec<(usize, usize)> = before.chords.iter().map(|(index, _)| *index).enumerate().collect();
        let of_trial = |index: usize| self.sweep.transcribed().program.is_of_trial(index);
        let chords: Vec<(usize, usize)> = chords.into_iter().filter(|(_, index)| of_trial(*index)).collect();
        chords.into_iter().find_map(|(place, index)| self.crossing_of(before, next, signs, (place, index)))
    }

    /// The same of one chord, by its place among those that are seen and among the signs. It is followed towards zero as
    /// long as it changes as it did; from nearby its tangent tells where it passes.
    fn crossing_of(
        &mut self,
        before: &View,
        next: f64,
        signs: &[f64],
        (place, index): (usize, usize),
    ) -> Option<Crossing> {
        /// These parts of the way to where it seems to vanish.
        const TOWARD: [f64; 5] = [0.98, 0.9, 0.7, 0.4, 0.1];
        /// Looks on the way.
        const MOST: usize = 12;
        /// What is left of it where it counts as passing.
        const LEFT: f64 = 0.05;
        /// Its rate may change by this part on one part of the way.
        const STEADY: f64 = 0.5;
        /// So far a tangent may lead, in steps.
        const FARTHEST: f64 = 1.5;
        let step = next - before.at;
        let half_and_rate = |view: &View| {
            let (_, square) = view.chords.get(place)?;
            let half = square.value.sqrt();
            (square.value > 0.0 && square.slope * step < 0.0).then(|| (half, square.slope / (2.0 * half)))
        };
        let (first, mut rate) = half_and_rate(before)?;
        // Where it nearly vanishes already, next to nothing is left to follow.
        let scale = first.max((rate * step).abs());
        let (mut half, mut here, mut seen) = (first, before.at, None);
        let mut own = before.expecting(signs);
        for _ in 0..MOST {
            let at = here - half / rate;
            // It may vanish sooner than a tangent says.
            if !(0.0..=FARTHEST).contains(&((at - before.at) / step)) {
                return None;
            }
            let nearer = TOWARD.into_iter().find_map(|part| {
                let view = self.view(here + part * (at - here), &own);
                let (left, now) = half_and_rate(&view).filter(|_| view.goes_on(FAR_ASTRAY))?;
                // It has changed as its tangents at both ends say, and no other assembly was taken for this one.
                let expected = half + 0.5 * (rate + now) * (view.at - here);
                let steady = (now / rate - 1.0).abs() <= STEADY;
                (steady && (left - expected).abs() <= 0.2 * left.max((1.0 - part) * half))
                    .then_some((left, now, view))
            });
            let Some((left, now, view)) = nearer else { break };
            (half, rate, here) = (left, now, view.at);
            own = view.expecting(&own);
            seen = Some(view);
            if half <= LEFT * LEFT * scale {
                break;
            }
        }
        let sign = signs.get(index).copied().unwrap_or(1.0);
        let at = here - half / rate;
        (half <= LEFT * scale && (at - before.at) / step <= 1.0).then_some(Crossing {
            index,
            at,
            rate: rate * sign,
            seen,
        })
    }

    /// Beyond such a place the mechanism goes on with the other meeting point: what is tried goes on as it did, or back the
    /// way it came, whichever has the half chord as large as it is expected. The signs from there on, and what is seen.
    fn beyond(
        &mut self,
        crossing: &Crossing,
        next: f64,
        step: f64,
        signs: &[f64],
    ) -> Option<(Vec<f64>, View)> {
        /// These parts of the way to the next look.
        const FARTHER: [f64; 7] = [1.0, 0.3, 0.1, 0.03, 1e-2, 1e-3, 1e-4];
        /// So far beside what is expected the half chord may be, and what is tried beside its mirror image.
        const BESIDE: f64 = 0.3;
        let Crossing { index, at, rate, ref seen } = *crossing;
        let near = seen.as_ref().map(|seen| seen.expecting(signs));
        let own = near.as_deref().unwrap_or(signs);
        let farthest = if ((next - at) / step) < 0.3 { 0.3 * step } else { next - at };
        for part in FARTHER {
            let way = part * farthest;
            let mirrored = self.view(at - way, own);
            let expected = rate * way;
            let mut best: Option<(f64, Vec<f64>, View)> = None;
            for trial in &mirrored.standing {
                let onward = trial.at.value + 2.0 * way * trial.at.slope;
                let ways = [(trial.at.value, -trial.at.slope), (onward, trial.at.slope)];
                for ((stands, moves), sense) in ways.into_iter().flat_map(|way| [(way, 1.0), (way, -1.0)]) {
                    let mut other = mirrored.expecting(signs);
                    other[index] = -other[index];
                    let numbers = other.get_mut(trial.index..trial.index + 4)?;
                    numbers.copy_from_slice(&[at + way, stands, moves, sense]);
                    let there = self.view(at + way, &other);
                    let Some((_, square)) = there.chords.iter().find(|(of, _)| *of == index) else {
                        continue;
                    };
                    let half = other[index] * square.value.max(0.0).sqrt();
                    let off = ((half - expected) / expected).abs();
                    let better = best.as_ref().is_none_or(|(least, ..)| off < *least);
                    if there.goes_on(FAR_ASTRAY) && off <= BESIDE && better {
                        best = Some((off, there.expecting(&other), there));
                    }
                }
            }
            if let (true, Some((_, signs, there))) = (mirrored.closes(), best) {
                return Some((signs, there));
            }
        }
        None
    }

    /// What happens between two looks in one assembly.
    fn events_between(&mut self, before: &View, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        self.dead_positions(now, signs, events);
        self.centres_at_infinity(now, signs, events);
        self.extremes(before, now, signs, events);
    }

    fn limit(&mut self, at: f64, signs: &[f64]) -> Event {
        let view = self.view(at, signs);
        // Where no two arcs touch it is a trial that finds nothing beyond.
        let touch = view.chords.iter().any(|(_, square)| square.value.abs() < SHORT);
        if let (false, Some(trial)) = (touch, view.standing.first()) {
            return Event { at, kind: EventKind::Limit, reason: trial.reason };
        }
        let nearest = (0..view.chords.len()).min_by(|&a, &b| {
            let part = |(_, c): (usize, Dual)| c.value.abs() / c.slope.abs().max(f64::MIN_POSITIVE);
            part(view.chords[a]).total_cmp(&part(view.chords[b]))
        });
        let reason = nearest.and_then(|chord| self.sweep.transcribed().program.reason_of_chord(chord));
        Event { at, kind: EventKind::Limit, reason }
    }

    /// Divisors, other than half chords, that pass zero.
    fn dead_positions(&mut self, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        let size = self.sweep.size();
        for (index, &divisor) in now.divisors.iter().enumerate() {
            let Some(before) = crossed(&mut self.divisors[index], now.at, divisor) else { continue };
            let (a, b) = (before.1, divisor.value);
            let alone = self.sweep.transcribed().program.excerpt([LookedFor::Divisor(index)]);
            let at = root(size, before, (now.at, b), |x| {
                let [divisor] = alone.look(x, signs, &mut self.place);
                divisor.value
            });
            // A pole changes its sign as well, but does not vanish.
            let view = self.view(at, signs);
            let there = view.divisors[index].value.abs();
            if there < a.abs().max(b.abs()) && view.is_clear() {
                let reason = self.sweep.transcribed().program.reason_of_divisor(index);
                events.push(Event { at, kind: EventKind::DeadPosition, reason });
            }
        }
    }

    /// Centres whose weight passes zero and whose reach does not: where both do, two of its lines have become one, and
    /// nothing happens to the mechanism there.
    fn centres_at_infinity(&mut self, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        let size = self.sweep.size();
        for (centre, &[.., weight]) in now.centres.iter().enumerate() {
            let Some(before) = crossed(&mut self.weights[centre], now.at, weight) else { continue };
            // Reach and weight of the centres stand behind the columns.
            let weights = self.sweep.columns.len() + 2;
            let alone = self.sweep.transcribed().program.excerpt([LookedFor::Asked(weights + 3 * centre)]);
            let at = root(size, before, (now.at, weight.value), |x| {
                let [weight] = alone.look(x, signs, &mut self.place);
                weight.value
            });
            let view = self.view(at, signs);
            let [x, y, left] = view.centres[centre];
            let vanishes = left.value.abs() < before.1.abs().max(weight.value.abs());
            if vanishes && (is_clear(x) || is_clear(y)) && view.is_clear() {
                let angle = libm::atan2(y.value, x.value).rem_euclid(PI);
                let direction = if angle >= PI { 0.0 } else { angle };
                events.push(Event { at, kind: EventKind::AtInfinity { centre, direction }, reason: None });
            }
        }
    }

    /// Where what is measured does not change between two places at which it changes the one way and the other.
    fn root_of_slope(&mut self, measure: Measure, from: (f64, f64), to: (f64, f64), signs: &[f64]) -> f64 {
        let (program, columns) = (&self.sweep.transcribed().program, &self.sweep.columns);
        let size = self.sweep.size();
        match measure {
            Measure::Column(column) => {
                let alone = program.excerpt([LookedFor::Asked(column)]);
                root(size, from, to, |x| {
                    let [m] = alone.look(x, signs, &mut self.place);
                    columns[column].counted(unrounded(m)).slope
                })
            }
            Measure::Magnitude([first, second]) => {
                let alone = program.excerpt([first, second].map(LookedFor::Asked));
                root(size, from, to, |x| {
                    let [x, y] = alone.look(x, signs, &mut self.place);
                    let [x, y] = [x, y].map(unrounded);
                    square_of([columns[first].counted(x), columns[second].counted(y)]).slope
                })
            }
        }
    }

    /// What is measured at one place, with its error, and whether no two arcs just touch there.
    fn measured_at(&mut self, measure: Measure, at: f64, signs: &[f64], arcs_cross: bool) -> (Dual, bool) {
        if !arcs_cross || self.sweep.tries() {
            let view = self.view(at, signs);
            return (view.measured(measure), view.is_clear());
        }
        // In a long chain, or beside many other numbers, all of them would be looked at for the sake of one.
        let (program, columns) = (&self.sweep.transcribed().program, &self.sweep.columns);
        let there = match measure {
            Measure::Column(column) => {
                let alone = program.excerpt([LookedFor::Asked(column)]);
                let [m] = alone.look_closely(at, signs, &mut self.place);
                columns[column].counted(m)
            }
            Measure::Magnitude(both) => {
                let alone = program.excerpt(both.map(LookedFor::Asked));
                let [x, y] = alone.look_closely(at, signs, &mut self.place);
                square_of([columns[both[0]].counted(x), columns[both[1]].counted(y)])
            }
        };
        (there, true)
    }

    fn extremes(&mut self, before: &View, now: &View, signs: &[f64], events: &mut Vec<Event>) {
        let arcs_cross = before.stays_clear(now);
        for &measure in self.sweep.measures() {
            let (a, b) = (before.measured(measure), now.measured(measure));
            if (a.slope < 0.0) == (b.slope < 0.0) {
                continue;
            }
            // A slope of rounding only is no extreme.
            let still = |m: Dual| (m.slope * (now.at - before.at)).abs() <= ERRORS * m.error;
            if still(a) && still(b) {
                continue;
            }
            let at = self.root_of_slope(measure, (before.at, a.slope), (now.at, b.slope), signs);
            let (there, is_clear_there) = self.measured_at(measure, at, signs, arcs_cross);
            let value = match measure {
                Measure::Column(_) => there.value,
                // A magnitude within its error is zero.
                Measure::Magnitude(_) if !is_clear(there) => 0.0,
                Measure::Magnitude(_) => there.value.sqrt(),
            };
            let ascending = now.at > before.at;
            // Where the walk begins on the extreme itself its slope is zero: what comes after tells which it is.
            let beyond = (a.slope < 0.0) != ascending;
            // A size that falls to zero and rises again has its least there, though its slope jumps.
            let touches = !beyond && a.value > 0.0 && b.value > 0.0 && !is_clear(there);
            let value = if touches { 0.0 } else { value };
            // Where a slope jumps otherwise, or passes through infinity, nothing is extreme.
            let vanishes = touches || there.slope.abs() <= STILL * a.slope.abs().max(b.slope.abs());
            // What it rises or falls by on both sides may be rounding.
            let differs = |m: Dual| (there.value - m.value).abs() > there.error + m.error;
            if value.is_finite() && vanishes && (differs(a) || differs(b)) && is_clear_there {
                let column = measure.first();
                let kind = if beyond {
                    EventKind::Greatest { column, value }
                } else {
                    EventKind::Least { column, value }
                };
                events.push(Event { at, kind, reason: None });
            }
        }
    }
}

/// Walks the whole range from the start, up and down.
///
/// Gives also at how many positions it has looked.
pub(super) fn walk(sweep: &Sweep, start: f64, looks: u32) -> (Vec<Stretch>, Vec<Event>, u64) {
    let [from, to] = sweep.range;
    let signs = sweep.transcribed().program.signs();
    let (mut looked, mut looked_back) = (0, 0);
    let mut go = |end: f64| {
        let (mut stretches, mut events) = (Vec::new(), Vec::new());
        let mut walker = Walker::new(sweep);
        walker.go(&nodes(start, end, looks, to - from), signs.clone(), &mut stretches, &mut events);
        looked += walker.place.looks();
        (stretches, events)
    };
    let (mut stretches, mut events);
    if sweep.whole_turn && sweep.input == InputKind::Time {
        // A period, from its beginning.
        (stretches, events) = go(to);
    } else if sweep.whole_turn {
        // Once round. Where the way up ends, the way down may still lead on, past the zero of the turn.
        (stretches, events) = go(start + (to - from));
        let mut wound = Vec::new();
        if stretches.iter().any(|s| s.apart) || stretches.last().is_none_or(|s| s.to < start + (to - from)) {
            let (down, on_the_way) = go(start - (to - from));
            let last = down.iter().filter(|s| !s.apart).min_by(|a, b| a.from.total_cmp(&b.from));
            let reached = last.map_or(start, |s| s.from);
            // A limit that is met from both sides is found at two places within its own rounding.
            let mut walker = Walker::new(sweep);
            let blur = last.map_or(0.0, |s| walker.view(reached, &s.signs).blur());
            looked_back = walker.place.looks();
            let above = |x: f64| x < reached + (to - from) - seam(sweep).max(blur);
            stretches.retain(|s| !s.apart || above(s.to));
            stretches.extend(down.into_iter().filter(|s| !s.apart));
            events.retain(|e| above(e.at));
            events.extend(on_the_way.into_iter().filter(|e| e.at >= reached - seam(sweep)));
        } else {
            wound = wound_up(sweep, start, &stretches);
        }
        (stretches, events) = wrapped(sweep, start, (stretches, events), &wound);
    } else {
        let (up, down);
        (up, events) = go(to);
        let below;
        (down, below) = go(from);
        events.extend(below);
        stretches = down;
        stretches.extend(up);
        // A change point at an end of the range is found within its rounding: the row of the end belongs to what ends there.
        let seam = seam(sweep);
        for stretch in &mut stretches {
            if (stretch.from - from).abs() < seam {
                stretch.from = from;
            }
            if (stretch.to - to).abs() < seam {
                stretch.to = to;
            }
        }
    }
    looked += looked_back;
    if sweep.whole_turn {
        looked += events_at_the_seam(sweep, start, looks, &stretches, &mut events);
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
    if sweep.tries() {
        // Where a trial finds nothing beyond, what is divided by on the way to the speeds vanishes as well.
        let limits: Vec<f64> = events.iter().filter(|e| e.kind == EventKind::Limit).map(|e| e.at).collect();
        let at_limit = |at: f64| limits.iter().any(|limit| (limit - at).abs() <= AT_LIMIT * sweep.size());
        events.retain(|e| e.kind != EventKind::DeadPosition || !at_limit(e.at));
    }
    // Where one goes on from the other their ends are one.
    for next in 1..stretches.len() {
        let end = stretches[next - 1].to;
        if (end - stretches[next].from).abs() <= seam(sweep) {
            stretches[next].from = end;
        }
    }
    events.sort_by(|a, b| a.at.total_cmp(&b.at));
    // A limit that is met from both sides is found twice within its own rounding.
    events.dedup_by(|next, last| {
        let limits = [&*next, &*last].iter().all(|e| e.kind == EventKind::Limit);
        limits && next.reason == last.reason && next.at - last.at <= AT_LIMIT * sweep.size()
    });
    (stretches, events, looked)
}

/// What is extreme, or vanishes, just where the turn begins and ends is rounding at both ends of the walk: a look
/// across finds it. Gives at how many positions it has looked.
fn events_at_the_seam(
    sweep: &Sweep,
    start: f64,
    looks: u32,
    stretches: &[Stretch],
    events: &mut Vec<Event>,
) -> u64 {
    let turn = sweep.range[1] - sweep.range[0];
    let half = turn / f64::from(looks) / 2.0;
    let home = |x: f64| {
        let inside = x - turn * ((x - sweep.range[0]) / turn).floor();
        if sweep.range[1] - inside < seam(sweep) { sweep.range[0] } else { inside }
    };
    let here = |x: f64| stretches.iter().find(|s| (s.from..=s.to).contains(&home(x)) && !s.apart);
    let [Some(before), Some(after)] = [here(start - half), here(start + half)] else { return 0 };
    let program = &sweep.transcribed().program;
    if program.sides(&before.signs) != program.sides(&after.signs) {
        return 0;
    }
    let from_home = start - half - home(start - half);
    let signs = program.shifted(&before.signs, from_home);
    let mut walker = Walker::new(sweep);
    let mut found = Vec::new();
    walker.go(&[start - half, start + half], signs, &mut Vec::new(), &mut found);
    for event in found {
        if matches!(event.kind, EventKind::Limit | EventKind::ChangePoint) {
            // These were met on the way.
            continue;
        }
        let same = |other: &Event| match (other.kind, event.kind) {
            (EventKind::Least { column: of, .. }, EventKind::Least { column, .. })
            | (EventKind::Greatest { column: of, .. }, EventKind::Greatest { column, .. }) => of == column,
            (EventKind::AtInfinity { centre: of, .. }, EventKind::AtInfinity { centre, .. }) => of == centre,
            (EventKind::DeadPosition, EventKind::DeadPosition) => other.reason == event.reason,
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
    walker.place.looks()
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
pub(super) fn seam(sweep: &Sweep) -> f64 {
    ERRORS * f64::EPSILON * sweep.size()
}

/// By how many half turns each angle that goes on has gone on in a whole turn of the input, with its place among the signs.
fn wound_up(sweep: &Sweep, start: f64, stretches: &[Stretch]) -> Vec<(usize, f64)> {
    let (Some(first), Some(last)) = (stretches.first(), stretches.last()) else { return Vec::new() };
    let mut walker = Walker::new(sweep);
    let mut angles = |at: f64, signs: &[f64]| -> Vec<(usize, f64)> {
        let turns = walker.view(at, signs).turns.into_iter();
        turns.map(|(index, away)| (index, away + PI * signs.get(index).copied().unwrap_or(0.0))).collect()
    };
    let before = angles(start, &first.signs);
    let after = angles(start + (sweep.range[1] - sweep.range[0]), &last.signs);
    let gone = before.into_iter().zip(after);
    gone.map(|((index, before), (_, after))| (index, 2.0 * ((after - before) / (2.0 * PI)).round())).collect()
}

/// Brings what was met on the way round into one turn. What lies behind the start there was met a turn later: an angle that
/// goes on is as much less wound up as it is by a turn, so that it leads on from the start both ways.
fn wrapped(
    sweep: &Sweep,
    start: f64,
    (stretches, events): (Vec<Stretch>, Vec<Event>),
    wound: &[(usize, f64)],
) -> (Vec<Stretch>, Vec<Event>) {
    let ([from, to], seam) = (sweep.range, seam(sweep));
    let turn = to - from;
    let home = |x: f64| {
        let inside = x - turn * ((x - from) / turn).floor();
        if inside - from < seam || to - inside < seam { from } else { inside }
    };
    let of_start = home(start) - start;
    let shifted = |stretch: &Stretch, by: f64| {
        let mut signs = sweep.transcribed().program.shifted(&stretch.signs, by);
        let turns = ((by - of_start) / turn).round();
        for &(index, half_turns) in wound {
            signs[index] += turns * half_turns;
        }
        signs
    };
    let mut cut = Vec::new();
    for stretch in stretches {
        let begin = home(stretch.from);
        let end = begin + (stretch.to - stretch.from);
        let signs = shifted(&stretch, begin - stretch.from);
        if end > to + seam {
            let beyond = Stretch {
                from,
                to: end - turn,
                signs: shifted(&stretch, begin - stretch.from - turn),
                ..stretch
            };
            cut.push(Stretch { from: begin, to, signs, ..stretch });
            cut.push(beyond);
        } else {
            cut.push(Stretch { from: begin, to: if to - end < seam { to } else { end }, signs, ..stretch });
        }
    }
    let mut events: Vec<Event> = events.into_iter().map(|e| Event { at: home(e.at), ..e }).collect();
    events.sort_by(|a, b| a.at.total_cmp(&b.at));
    (cut, events)
}

#[cfg(test)]
mod tests {
    use super::super::Sweep;
    use crate::board::{Dual, LookedFor, Workspace};
    use crate::catalogue::KINDS;

    /// A coupler with twice as many points costs twice as much to walk with: for the sake of one extreme not everything else is
    /// looked at, of which there are as many.
    #[test]
    fn extremes_of_many_numbers_cost_as_much_as_each_alone() {
        let operations = |count: usize| {
            let mut joins = vec!["A".to_owned(), "B".to_owned()];
            joins.extend((0..count).map(|k| format!("Z{k}")));
            let mut line = vec![0.0, 100.0];
            line.extend((0..count).map(|k| 1.0 + 97.0 * k as f64 / count as f64));
            let scene = serde_json::json!({
                "units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [110, 0]},
                "links": {"2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": joins, "line": line},
                          "4": {"joins": ["O4", "B"], "length": 80}},
                "near": {"B": [90, 75]}, "input": {"link": 2, "angle": 60, "omega": "10 rad/s ccw"}
            });
            let scene = crate::scene::read(&scene.to_string(), "points.json").unwrap();
            let sweep = Sweep::new(&scene.mechanism, None).unwrap();
            assert!(sweep.events.len() > 4 * count, "{} events", sweep.events.len());
            let mut walker = super::Walker::new(&sweep);
            let way = super::nodes(sweep.start, sweep.start + 6.0, 720, 6.0);
            let signs = sweep.transcribed().program.signs();
            walker.go(&way, signs, &mut Vec::new(), &mut Vec::new());
            walker.place.operations()
        };
        let [few, many] = [60, 120].map(operations);
        assert!(many < few * 22 / 10, "{few} operations grow to {many}");
    }

    /// A part of a drawing gives what the whole of it gives, to the last bit.
    #[test]
    fn what_is_looked_for_alone_is_what_is_found_with_all() {
        let mut compared = 0;
        for kind in KINDS {
            let scene = crate::scene::read(kind.scene, kind.name).unwrap();
            let Ok(sweep) = Sweep::new(&scene.mechanism, None) else { continue };
            let program = &sweep.transcribed().program;
            let (mut whole, mut part) = (Workspace::default(), Workspace::default());
            for stretch in &sweep.stretches {
                for at in [0.13, 0.5, 0.81].map(|t| stretch.from + t * (stretch.to - stretch.from)) {
                    program.look(at, &stretch.signs, &mut whole);
                    let asked = program.asked(&whole).enumerate();
                    let asked = asked.map(|(index, all)| (LookedFor::Asked(index), all));
                    let divisors = program.divisors(&whole).enumerate();
                    let divisors = divisors.map(|(index, all)| (LookedFor::Divisor(index), all));
                    for (sought, all) in asked.chain(divisors) {
                        let excerpt = program.excerpt([sought]);
                        let [close] = excerpt.look_closely(at, &stretch.signs, &mut part);
                        let numbers = |m: Dual| [m.value, m.slope, m.error].map(f64::to_bits);
                        let exact = close.value.is_nan() || numbers(close) == numbers(all);
                        assert!(exact, "{} at {at}: {sought:?} is {close:?}, not {all:?}", kind.name);
                        let [alone] = excerpt.look(at, &stretch.signs, &mut part);
                        let bits =
                            |value: f64| if value.is_nan() { f64::NAN.to_bits() } else { value.to_bits() };
                        let same =
                            bits(alone.value) == bits(all.value) && bits(alone.slope) == bits(all.slope);
                        assert!(
                            same,
                            "{} at {at}: {sought:?} is {alone:?} alone, {all:?} with all",
                            kind.name
                        );
                        compared += 1;
                    }
                }
            }
        }
        assert!(compared > 3000, "{compared} numbers");
    }
}
