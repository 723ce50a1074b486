//! By how much an answer may be off: the one rule by which keys of exams are written and solutions are graded.
//!
//! A number has one tolerance, a vector one for its magnitude and one for its direction, a place one for each of its
//! coordinates. What is calculated from what is given is good to three figures. What is read off the drawing is good to
//! what careful draughtsmen scatter at that place, with some room, and to three figures at least; but never to more than
//! a stated part of its value, as long as a ruler can tell that much.
//!
//! **Architecture Invariant:** neither `exam` nor `grade` has a rule of its own.

use crate::board::Hand;
use crate::graphical::construction::{Act, Calculation, Construction};
use crate::graphical::{Draughtsmen, HandError, Scales, Slip, Slips};
use crate::mechanism::force::Force;
use crate::mechanism::quantity::{Answer, Nature, Quantity};
use crate::mechanism::{Input, LinkId, Mechanism, Place, PointId};
use crate::scene::Scene;
use crate::solve::{SolveError, Solved, by_hand};

/// Where nothing is said, no answer may be off by more than a tenth.
pub const MAX_TOLERANCE: f64 = 0.1;
/// So many draughtsmen draw a solution.
pub const DRAUGHTSMEN: u64 = 96;

/// The worst of the draughtsmen is not the worst of all.
pub(crate) const SAFETY: f64 = 1.3;
/// Three significant figures are asked for: a number that is right to them is right.
const THREE_FIGURES: f64 = 0.005;
/// A direction is read to half a degree.
const HALF_DEGREE: f64 = 0.5 * DEGREE;
/// A direction that is drawn or measured once is good to this.
const DIRECTION: f64 = DEGREE;
/// However a tolerance is capped, so many readings off the paper are always allowed.
pub(crate) const FINEST: f64 = 2.0;
/// A rate that is smaller than this part of the largest one is read no finer than if it were as large as that.
const SMALL: f64 = 0.1;
/// What is smaller than this part of the slip is nothing for the hand.
const NOTHING: f64 = 1e-6;

const DEGREE: f64 = std::f64::consts::PI / 180.0;

/// Whose drawings are judged, and how strictly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Standard {
    /// How exact they draw.
    pub hand: Hand,
    /// How many draughtsmen show how far a hand scatters.
    pub draughtsmen: u64,
    /// No tolerance is a larger part of its value.
    pub max_tolerance: f64,
}

/// Why an answer may be off by what it may.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Basis {
    /// It is calculated from what is given: no drawing is behind it.
    Calculated,
    /// It is read off the drawing, or calculated from what is.
    Read,
}

/// By how much something may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Room {
    /// What is allowed.
    pub by: f64,
    /// What would be without a cap: more than the worst of many draughtsmen.
    pub free: f64,
    /// What nineteen of twenty careful draughtsmen stay within.
    pub honest: f64,
    /// That is more than the stated part: nobody should be asked for it.
    pub loose: bool,
    /// What is allowed is more than the stated part: the value is small beside a reading, or beside the largest of its kind.
    pub over_cap: bool,
}

/// By how much an answer may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowance {
    /// The number, the magnitude of a vector, or each coordinate of a place, SI.
    pub size: Room,
    /// The direction of a vector, radians.
    pub direction: Option<Room>,
    /// Why.
    pub basis: Basis,
}

impl Allowance {
    /// Whether some part of it is loose.
    #[must_use]
    pub fn loose(&self) -> bool {
        self.size.loose || self.direction.is_some_and(|direction| direction.loose)
    }
}

/// Whether the two components of a quantity are a place, which has no direction of its own.
#[must_use]
pub fn is_place(quantity: &Quantity) -> bool {
    quantity.nature() == Nature::Place
}

/// Whether a number is an angle: part of a turn and not of itself.
#[must_use]
pub fn is_angle(quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Angle(_) | Quantity::Transmission(..) => true,
        Quantity::Cycle(of) => of.is_angle(),
        _ => false,
    }
}

/// What the tolerances of a solution hang on.
#[derive(Debug, Clone)]
pub struct Ground {
    standard: Standard,
    scales: Scales,
    /// What is calculated from what is given, with no reading behind it.
    calculated: Vec<Quantity>,
    /// Links of which ω and ε are given.
    given: Vec<LinkId>,
    /// The largest ω and ε.
    rates: [f64; 2],
    /// The largest torque or moment among all that is balanced, N m.
    torque: f64,
    /// Places of the fixed points, m.
    fixed: Vec<[f64; 2]>,
}

impl Ground {
    /// Of a solution at these scales.
    #[must_use]
    pub fn new(
        mechanism: &Mechanism,
        construction: &Construction,
        scales: Scales,
        standard: Standard,
    ) -> Self {
        let given: Vec<LinkId> = mechanism
            .inputs
            .iter()
            .filter_map(|input| match *input {
                Input::Angle { link, .. } => Some(link),
                Input::Speed { .. } | Input::Slide { .. } => None,
            })
            .collect();
        let fixed = mechanism.points.iter().filter_map(|point| match &point.place {
            Place::Fixed(at) => Some(at.map(|x| x.value)),
            _ => None,
        });
        Self {
            standard,
            scales,
            calculated: calculated(mechanism, construction),
            given,
            rates: largest_rates(mechanism, construction),
            torque: largest_torque(construction),
            fixed: fixed.collect(),
        }
    }

    /// Whose drawings are judged.
    #[must_use]
    pub const fn standard(&self) -> Standard {
        self.standard
    }

    /// SI units for a millimetre of what stands for a quantity on paper.
    #[must_use]
    pub fn si_of(&self, quantity: &Quantity) -> f64 {
        match (quantity, self.scales.paper().force) {
            (Quantity::Force(force, _), Some(newtons)) if force.is_vector() => newtons,
            // Centres are found for velocities, and stand on the skeleton.
            (Quantity::Centre(..), _) => self.scales.length(),
            _ => self.scales.of(quantity.order().dimension()),
        }
    }

    /// Whether a quantity is calculated from what is given, and no reading is behind it.
    #[must_use]
    pub fn is_calculated(&self, quantity: &Quantity) -> bool {
        match quantity {
            Quantity::Omega(link) | Quantity::Alpha(link) => self.given.contains(link),
            _ => self.calculated.contains(quantity),
        }
    }

    /// By how much an answer to a quantity may be off: its right numbers, the unit in which it is told, and how far
    /// draughtsmen were off.
    #[must_use]
    pub fn allowed(&self, quantity: &Quantity, value: &[f64], unit: f64, slips: Slips) -> Allowance {
        let amount = size(value);
        if !self.is_calculated(quantity) {
            return self.read(quantity, value, unit, slips, 1.0);
        }
        let by = told(THREE_FIGURES * amount, unit);
        let exact = |by: f64| Room { by, free: by, honest: by, loose: false, over_cap: false };
        let hand = self.standard.hand;
        let direction = (value.len() == 2).then(|| exact(told(DIRECTION.max(3.0 * hand.angle), DEGREE)));
        Allowance { size: exact(by), direction, basis: Basis::Calculated }
    }

    /// The same of what is read off the drawing in any case, by a reading that is `enlarged` times as large as it should be.
    #[must_use]
    pub fn read(
        &self,
        quantity: &Quantity,
        value: &[f64],
        unit: f64,
        slips: Slips,
        enlarged: f64,
    ) -> Allowance {
        let amount = size(value);
        let most = self.standard.max_tolerance;
        let hand = self.standard.hand;
        let linear = value.len() == 2;
        // One reading more than the drawing itself: the length that is handed in.
        let reading = if linear { hand.length * self.si_of(quantity) * enlarged } else { 0.0 };
        // What the slips are allowed to be, what they are, the cap, and what is never too fine.
        let room = |[free, honest]: [f64; 2], cap: f64, least: Option<f64>, unit: f64| {
            let allowed = least.map_or(cap, |least| cap.max(least));
            // A part of nothing is no measure: that something is zero can be read.
            let measured = cap > NOTHING * honest;
            // What is read has its room, a cap is not passed.
            let by = told_up(free, unit).min(told(allowed, unit));
            let [loose, over_cap] = [honest, by].map(|one| measured && one > cap);
            Room { by, free, honest, loose, over_cap }
        };
        let spread = |part: fn(&Slip) -> f64, reading: f64, least: f64| {
            [SAFETY * part(&slips.worst) + reading, part(&slips.most)].map(|slip| slip.max(least))
        };
        let figures = THREE_FIGURES * amount;
        let turned = libm::asin(most.min(1.0)).max(HALF_DEGREE);
        let (size, direction) = if is_angle(quantity) {
            (room(spread(|s| s.whole, 0.0, HALF_DEGREE), turned, None, unit), None)
        } else if is_place(quantity) {
            let cap = most * self.distance(value);
            (room(spread(|s| s.whole, reading, figures), cap, Some(FINEST * reading), unit), None)
        } else if linear {
            let least = Some(FINEST * reading);
            let size = room(spread(|s| s.size, reading, figures), most * amount, least, unit);
            let askew = if amount > reading { reading / amount } else { 0.0 };
            let mut direction = room(spread(|s| s.turn, askew, HALF_DEGREE), turned, None, DEGREE);
            // What may be nothing points nowhere.
            if amount <= size.by {
                direction.by = std::f64::consts::PI;
                direction.loose = size.loose;
            }
            (size, Some(direction))
        } else {
            (room(spread(|s| s.whole, reading, figures), most * amount, self.finest(quantity), unit), None)
        };
        Allowance { size, direction, basis: Basis::Read }
    }

    /// No tolerance of an answer that follows from this value is larger, and of a vector none of its direction.
    #[must_use]
    pub fn most(&self, quantity: &Quantity, value: &[f64]) -> [f64; 2] {
        let turned = libm::asin(self.standard.max_tolerance.min(1.0)).max(HALF_DEGREE);
        if is_place(quantity) || is_angle(quantity) {
            return [f64::INFINITY, turned];
        }
        let reading = FINEST * self.standard.hand.length * self.si_of(quantity);
        let least = if value.len() == 2 { Some(reading) } else { self.finest(quantity) };
        let most = (self.standard.max_tolerance + THREE_FIGURES) * size(value);
        [least.map_or(most, |least| most.max(least)), turned]
    }

    /// However small a number is, nobody reads it finer than this; `None` where that is not told.
    fn finest(&self, quantity: &Quantity) -> Option<f64> {
        let part = self.standard.max_tolerance * SMALL;
        match quantity {
            Quantity::Omega(_) | Quantity::RelativeOmega(..) => Some(part * self.rates[0]),
            Quantity::Alpha(_) | Quantity::RelativeAlpha(..) => Some(part * self.rates[1]),
            Quantity::Force(Force::Offset(_) | Force::Arm(..), _) => {
                Some(FINEST * self.standard.hand.length * self.scales.length())
            }
            Quantity::Force(force, _) if force.turns() => Some(part * self.torque),
            _ => None,
        }
    }

    /// How far a place is from the nearest fixed point; from the origin where none is fixed.
    fn distance(&self, at: &[f64]) -> f64 {
        let [x, y] = *at else { return size(at) };
        let far = self.fixed.iter().map(|fixed| libm::hypot(x - fixed[0], y - fixed[1]));
        far.reduce(f64::min).unwrap_or_else(|| size(at))
    }
}

/// An asked quantity: how far hands are off, and by how much an answer may be.
#[derive(Debug, Clone)]
pub struct Tolerated {
    /// What the draughtsmen made of it.
    pub hand: HandError,
    /// `None` where it has no number, or nobody can draw it.
    pub allowed: Option<Allowance>,
}

/// Of every asked quantity of a solution, by how much an answer may be off.
///
/// # Errors
/// Where not even a perfect hand can draw it.
pub fn of_asked(scene: &Scene, solved: &Solved, standard: Standard) -> Result<Vec<Tolerated>, SolveError> {
    let construction = &solved.solution.construction;
    let ground = Ground::new(&scene.mechanism, construction, solved.scales, standard);
    let draughtsmen = Draughtsmen { hand: standard.hand, number: standard.draughtsmen };
    let hands = by_hand(scene, solved, draughtsmen)?;
    let asked = scene.mechanism.asked.iter().zip(&construction.answers);
    let tolerated = asked.zip(hands).map(|((asked, reading), hand)| {
        let value = numbers(&reading.answer);
        let allowed = value
            .zip(hand.slips)
            .map(|(value, slips)| ground.allowed(&asked.quantity, &value, asked.unit.si, slips));
        Tolerated { hand, allowed }
    });
    Ok(tolerated.collect())
}

/// The numbers of an answer, SI.
fn numbers(answer: &Answer) -> Option<Vec<f64>> {
    match answer {
        Answer::Scalar { value, .. } => Some(vec![*value]),
        Answer::Vector { value, .. } => Some(value.to_vec()),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => None,
    }
}

fn size(numbers: &[f64]) -> f64 {
    numbers.iter().fold(0.0, |sum, n| libm::hypot(sum, *n))
}

/// A tolerance as it is told, in two figures of a unit, never more than it is: what is printed is what is meant.
fn told(by: f64, unit: f64) -> f64 {
    in_figures(by, unit, |figures| libm::floor(figures + LITTLE))
}

/// The same, never less than it is.
fn told_up(by: f64, unit: f64) -> f64 {
    in_figures(by, unit, |figures| libm::ceil(figures - LITTLE))
}

fn in_figures(by: f64, unit: f64, rounded: fn(f64) -> f64) -> f64 {
    let own = by / unit;
    if own <= 0.0 || !own.is_finite() {
        return f64::max(by, f64::MIN_POSITIVE);
    }
    let place = libm::pow(10.0, libm::floor(libm::log10(own)) - 1.0);
    (rounded(own / place) * place * unit).max(f64::MIN_POSITIVE)
}

/// So that 2.3 is 2.3 and not a little less.
const LITTLE: f64 = 1e-6;

/// What is calculated from what is given alone.
fn calculated(mechanism: &Mechanism, construction: &Construction) -> Vec<Quantity> {
    let driven = |link: LinkId| {
        mechanism.inputs.iter().any(|input| match *input {
            Input::Angle { link: of, .. } | Input::Speed { link: of, .. } => of == link,
            Input::Slide { .. } => false,
        })
    };
    let acts = || construction.steps.iter().flat_map(|step| &step.acts);
    let measured = |[a, b]: [PointId; 2]| {
        acts().any(|act| {
            matches!(*act, Act::MeasureLength { from, to, .. } if [from, to] == [a, b] || [to, from] == [a, b])
        })
    };
    let found = acts().filter_map(|act| match *act {
        Act::Calculate(
            Calculation::Speed { quantity, link, ends, .. }
            | Calculation::Tangential { quantity, link, ends, .. },
        ) => (driven(link) && !measured(ends)).then_some(quantity),
        Act::Calculate(Calculation::Normal { quantity, ends, .. }) => {
            let whole = |link: LinkId| ends.iter().all(|p| mechanism.link(link).points.contains(p));
            let by_driven = mechanism.moving().any(|link| driven(link) && whole(link));
            (by_driven && !measured(ends)).then_some(quantity)
        }
        _ => None,
    });
    found.collect()
}

/// The largest ω and ε of a solution.
fn largest_rates(mechanism: &Mechanism, construction: &Construction) -> [f64; 2] {
    let acts = construction.steps.iter().flat_map(|step| &step.acts);
    let mut largest = acts.fold([0.0_f64; 2], |[w, e], act| match *act {
        Act::Calculate(Calculation::Omega { value, .. }) => [w.max(value.abs()), e],
        Act::Calculate(Calculation::Alpha { value, .. }) => [w, e.max(value.abs())],
        _ => [w, e],
    });
    for input in &mechanism.inputs {
        if let Input::Angle { omega, alpha, .. } = input {
            largest = [largest[0].max(omega.value.abs()), largest[1].max(alpha.value.abs())];
        }
    }
    largest
}

/// The largest torque and moment among all that is balanced.
fn largest_torque(construction: &Construction) -> f64 {
    let Some(sheet) = &construction.forces else { return 0.0 };
    let terms = sheet.moments.iter().flat_map(|balance| balance.terms.iter().chain([&balance.found]));
    let torques = sheet.bodies.iter().flat_map(|body| &body.torques).map(|(_, torque)| torque.abs());
    terms.map(|term| term.moment.abs()).chain(torques).fold(0.0, f64::max)
}

#[cfg(test)]
mod tests {
    use super::{told, told_up};

    #[test]
    fn a_tolerance_is_told_in_two_figures() {
        for (by, unit, expected) in
            [(0.023_4, 1.0, 0.023), (2.3, 1.0, 2.3), (0.0998, 0.01, 0.099), (96.0, 10.0, 96.0)]
        {
            assert!((told(by, unit) - expected).abs() < 1e-12, "{by} in {unit}: {}", told(by, unit));
        }
        for (by, expected) in [(0.023_4, 0.024), (2.3, 2.3), (9.91, 10.0)] {
            assert!((told_up(by, 1.0) - expected).abs() < 1e-12, "{by}: {}", told_up(by, 1.0));
        }
    }
}
