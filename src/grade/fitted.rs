//! What of the skeleton was laid off otherwise, where no number of it was handed in: a pivot, a length or the angle of the
//! input, at the value that brings all answers together.

use super::answers::Given;
use super::case::{Basis, Case, size};
use super::change::{Change, InputChange};
use super::kind::Kind;
use super::mistakes::Hypothesis;
use super::phrase::{Phrase, say};
use crate::mechanism::{Input, LinkId, Mechanism, Place, PointId};

/// A value that is found, not one of those that are usual: it must explain so many wrong answers at least.
const LEAST: usize = 3;
/// Where two numbers are found it must explain so many vectors, with their directions.
const VECTORS: usize = 2;
/// What a found number costs.
const FOUND: f64 = 3.0;
/// So often the value is mended.
const ROUNDS: usize = 5;
/// After so many times it is seen whether that leads anywhere.
const SOON: usize = 2;
/// By this part of its whole a value is moved to see what that does.
const NUDGE: f64 = 1e-4;
/// No more than this part of the whole is laid off otherwise by mistake.
const MOST: f64 = 0.4;
/// A point that closes no loop may stand farther from its place: parts of its arm, and radians.
const FREELY: f64 = 2.0;
/// Nine of ten answers come this near, in tolerances.
const NEAR: f64 = 1.25;

/// What may have been laid off otherwise.
#[derive(Clone, Copy)]
enum Laid {
    /// A fixed point; both coordinates.
    Pivot(PointId),
    /// The length between two joints of a link, by their places in it.
    Length(LinkId, [usize; 2]),
    /// The angle of an input.
    Angle(usize),
    /// A straight guide, by its slide: how far to its left.
    Guide(usize),
    /// The angle of a straight guide.
    GuideTurned(usize),
    /// Where a point of a link, by its place in it, stands about the link's first joint; length and angle.
    Point(LinkId, usize),
    /// The speed of all inputs.
    Speed,
}

impl Laid {
    /// All of a mechanism.
    fn all(mechanism: &Mechanism) -> Vec<Self> {
        let fixed = (0..mechanism.points.len()).map(PointId).filter(|point| mechanism.is_fixed(*point));
        let mut all: Vec<Self> = fixed.map(Self::Pivot).collect();
        // The drawing begins at the first: all others may stand elsewhere about it.
        if all.len() > 1 {
            all.remove(0);
        }
        let ends = [[0, 1], [1, 2], [0, 2]];
        all.extend(mechanism.moving().flat_map(|link| ends.map(|ends| Self::Length(link, ends))));
        let angles = mechanism.inputs.iter().enumerate();
        all.extend(angles.filter_map(|(index, input)| match input {
            Input::Angle { angle: Some(_), .. } | Input::Speed { angle: Some(_), .. } => {
                Some(Self::Angle(index))
            }
            _ => None,
        }));
        all.push(Self::Speed);
        all.extend(
            (0..mechanism.slides.len()).flat_map(|slide| [Self::Guide(slide), Self::GuideTurned(slide)]),
        );
        let points =
            |link: LinkId| (2..mechanism.link(link).points.len()).map(move |end| Self::Point(link, end));
        all.extend(mechanism.moving().flat_map(points));
        all.retain(|laid| laid.change([0.1, 0.1]).mechanism(mechanism).as_ref() != mechanism);
        all
    }

    /// How many numbers it is.
    fn numbers(self) -> usize {
        if let Self::Pivot(_) | Self::Point(..) = self { 2 } else { 1 }
    }

    /// The change by so many metres, parts of the length, or radians.
    fn change(self, by: [f64; 2]) -> Change {
        Change::of_inputs(match self {
            Self::Pivot(point) => InputChange::Pivot { point, by },
            Self::Length(link, ends) => InputChange::Length { link, ends, factor: 1.0 + by[0] },
            Self::Angle(input) => InputChange::Angle { input, by: by[0] },
            Self::Guide(slide) => InputChange::Guide { slide, across: by[0], turn: 0.0 },
            Self::GuideTurned(slide) => InputChange::Guide { slide, across: 0.0, turn: by[0] },
            Self::Point(link, end) => InputChange::Arm { link, end, factor: 1.0 + by[0], turn: by[1] },
            Self::Speed => InputChange::Rates { omega: 1.0 + by[0], alpha: 1.0 },
        })
    }
}

/// Everything that may have been laid off otherwise, as all answers together tell it; `open` are those that are wrong and
/// not explained. Where all the others follow from the first as it was handed in, only its own `data` tell of it: a fit with as
/// many free numbers fits whatever is handed in.
pub(super) fn laid_off(
    case: &Case<'_>,
    drawn: &Change,
    (open, data): (&[usize], Option<usize>),
) -> Vec<Hypothesis> {
    let handed_in: Vec<usize> = open.iter().copied().filter(|&index| !case.hands_in_nothing(index)).collect();
    let vectors = handed_in.iter().filter(|&&index| case.is_vector(index)).count();
    // Each value would lead a whole turning-moment diagram through its period.
    if case.cycle.is_some() {
        return Vec::new();
    }
    let fit = Fit { case, drawn, open, long: longest(case) };
    // A slip in the first number that is calculated looks like another speed: who hands that number in has made it there.
    let calculated = open.first().is_some_and(|&first| case.allowances[first].basis == Basis::Calculated);
    let all = Laid::all(&case.mechanism).into_iter();
    let all = all.filter(|laid| match laid {
        Laid::Speed => !calculated && handed_in.len() >= LEAST,
        // Two vectors of the point tell its place twice.
        Laid::Point(..) => vectors >= VECTORS,
        _ => handed_in.len() >= LEAST,
    });
    let all = all.filter(|laid| data.is_none_or(|data| laid.numbers() < data));
    all.filter_map(|laid| fit.found(laid)).collect()
}

/// The greatest distance of two joints of a link, metres.
fn longest(case: &Case<'_>) -> f64 {
    let space = &case.right.construction.space;
    let place = |point: &PointId| space.places.get(point.0).copied().flatten();
    let mut longest: f64 = 0.0;
    for link in case.mechanism.moving() {
        let places: Vec<[f64; 2]> = case.mechanism.link(link).points.iter().filter_map(place).collect();
        for a in &places {
            longest = places.iter().map(|b| libm::hypot(a[0] - b[0], a[1] - b[1])).fold(longest, f64::max);
        }
    }
    longest * space.metres_per_mm
}

struct Fit<'f, 's> {
    case: &'f Case<'s>,
    drawn: &'f Change,
    open: &'f [usize],
    long: f64,
}

impl Fit<'_, '_> {
    /// The least squares of what the answers miss, by Gauss and Newton.
    fn found(&self, laid: Laid) -> Option<Hypothesis> {
        let whole = match laid {
            Laid::Pivot(_) | Laid::Guide(_) => self.long,
            Laid::Point(..) => FREELY,
            Laid::Length(..) | Laid::Angle(_) | Laid::GuideTurned(_) | Laid::Speed => 1.0,
        };
        let at = |by: [f64; 2]| self.misses(&self.drawn.and(&laid.change(by)));
        let mut by = [0.0; 2];
        let mut misses = at(by)?;
        let start = size(&misses);
        for round in 0..ROUNDS {
            // What does not bring the answers together soon is not what was laid off otherwise.
            if round == SOON && size(&misses) > 0.5 * start {
                return None;
            }
            let mut slopes = Vec::new();
            for axis in 0..laid.numbers() {
                let mut nudged = by;
                nudged[axis] += NUDGE * whole;
                let moved = at(nudged)?;
                let slope: Vec<f64> =
                    moved.iter().zip(&misses).map(|(a, b)| (a - b) / (NUDGE * whole)).collect();
                slopes.push(slope);
            }
            let step = least_squares(&slopes, &misses)?;
            by = [0, 1].map(|axis| by[axis] + step[axis].clamp(-0.2 * whole, 0.2 * whole));
            if size(&by) > MOST * whole {
                return None;
            }
            misses = at(by)?;
        }
        let change = laid.change(by);
        self.explains(&self.drawn.and(&change)).then(|| {
            let (kind, at, how) = self.told(laid, by);
            let price = FOUND * laid.numbers() as f64;
            Hypothesis { kind, at, step: None, price, change, how: Some(how) }
        })
    }

    /// By how much every answer is missed, in tolerances, with its sign.
    fn misses(&self, change: &Change) -> Option<Vec<f64>> {
        let sketch = self.case.drawn(change, None)?;
        let seen = self.case.seen(&sketch, change);
        let mut misses = Vec::new();
        for (index, observation) in self.case.observations.iter().enumerate() {
            let Some(seen) = seen[index].as_deref() else { continue };
            let by = self.case.rooms[index].by;
            match (observation.given, seen) {
                (Given::Magnitude(given) | Given::Drawn(given), _) => misses.push((size(seen) - given) / by),
                (Given::Signed(given), &[value]) => misses.push((value - given) / by),
                (Given::Vector(given), &[x, y]) => misses.extend([(x - given[0]) / by, (y - given[1]) / by]),
                _ => {}
            }
        }
        misses.iter().all(|miss| miss.is_finite()).then_some(misses)
    }

    /// Whether nine of ten answers that are open are met.
    fn explains(&self, change: &Change) -> bool {
        let Some(sketch) = self.case.drawn(change, None) else { return false };
        let seen = self.case.seen(&sketch, change);
        let met = self.open.iter().filter(|index| {
            let now = seen[**index].as_deref();
            let room = self.case.rooms[**index].times(self.case.times_larger(**index, now));
            self.case.miss(**index, now, room) <= NEAR
        });
        10 * met.count() >= 9 * self.open.len()
    }

    fn told(&self, laid: Laid, by: [f64; 2]) -> (Kind, Phrase, Phrase) {
        let mechanism = &self.case.mechanism;
        let unit = &self.case.scene.units.length;
        let number = |metres: f64| super::text::digits(metres / unit.si, self.long / unit.si / 300.0);
        let name = |point: PointId| mechanism.point(point).name.clone();
        match laid {
            Laid::Pivot(point) => {
                let right = match mechanism.point(point).place {
                    Place::Fixed(at) => [0, 1].map(|axis| at[axis].value),
                    _ => [0.0; 2],
                };
                let [x, y] = right.map(number);
                let [own_x, own_y] = [right[0] + by[0], right[1] + by[1]].map(number);
                let how = say!("about ({}, {}) for ({}, {}) {}", own_x, own_y, x, y, unit.symbol);
                (Kind::PivotMisplaced, name(point).into(), how)
            }
            Laid::Length(link, ends) => {
                let [a, b] = ends.map(|end| mechanism.link(link).points[end]);
                (Kind::LengthLaidOff, say!("the length {}", name(a) + &name(b)), lengthened(by[0]))
            }
            Laid::Guide(slide) => {
                let at = super::misread::rider(mechanism, slide);
                (Kind::GuideMisplaced, at, say!("about {} {} away", number(by[0].abs()), unit.symbol))
            }
            Laid::GuideTurned(slide) => {
                let at = super::misread::rider(mechanism, slide);
                (Kind::GuideMisplaced, at, turned_too_far(by[0]))
            }
            Laid::Point(link, end) => {
                let points = &mechanism.link(link).points;
                let arm = name(points[0]) + &name(points[end]);
                let how = say!("{} {} and {}", arm, lengthened(by[0]), turned_too_far(by[1]));
                (Kind::PointLaidOff, name(points[end]).into(), how)
            }
            Laid::Speed => {
                let percent = (100.0 * by[0].abs()).round();
                let how = match by[0] > 0.0 {
                    true => say!("about {} % too fast", percent),
                    false => say!("about {} % too slow", percent),
                };
                (Kind::InputSpeed, say!("the input"), how)
            }
            Laid::Angle(_) => (Kind::InputAngle, say!("the input"), turned_too_far(by[0])),
        }
    }
}

/// By which part a length is too long.
fn lengthened(by: f64) -> Phrase {
    let percent = (100.0 * by.abs()).round();
    match by > 0.0 {
        true => say!("about {} % too long", percent),
        false => say!("about {} % too short", percent),
    }
}

/// By how much something is turned too far, radians.
fn turned_too_far(by: f64) -> Phrase {
    let degrees = format!("{:.0}", by.abs().to_degrees());
    match by < 0.0 {
        true => say!("about {}° too far clockwise", degrees),
        false => say!("about {}° too far counter-clockwise", degrees),
    }
}

/// The step against all misses, by what each number does to them; `None` where that is nothing.
fn least_squares(slopes: &[Vec<f64>], misses: &[f64]) -> Option<[f64; 2]> {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let step = match slopes {
        [one] => [-dot(one, misses) / dot(one, one), 0.0],
        [one, two] => {
            let [aa, ab, bb] = [dot(one, one), dot(one, two), dot(two, two)];
            let [a, b] = [dot(one, misses), dot(two, misses)];
            let whole = aa * bb - ab * ab;
            [(ab * b - bb * a) / whole, (ab * a - aa * b) / whole]
        }
        _ => return None,
    };
    step.iter().all(|part| part.is_finite()).then_some(step)
}
