//! Speed against accuracy: a scene's quantities by every setting of the program, each timed, and each held
//! against a reference of 75 digits.
//!
//! The reference is the same drawing in [`Wide`] arithmetic, with a bound of its own; it takes the scene's
//! numbers as double-double arithmetic reads them, so what is measured is what the setting does to these
//! numbers. An error is told as a part of the largest asked value of the same unit in its scene.

use std::hint::black_box;
use std::time::Instant;

use crate::analytic;
use crate::board::{Arithmetic, Hand, Real};
use crate::double_double::DoubleDouble;
use crate::graphical::{self, DrawError, Extents, Numbers, Scales};
use crate::mechanism::quantity::{Answer, Order, Quantity};
use crate::mechanism::structure::Structure;
use crate::plan::{Extent, Plan};
use crate::scene::Scene;
use crate::solve::{self, Settings, SolveError};
use crate::sweep::{Sweep, SweepError};
use crate::wide::Wide;

/// One way to get the numbers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Setting {
    /// The drawing with its record: strokes and bounds.
    Drawn(Arithmetic),
    /// The drawing without a record: numbers only.
    Unrecorded(Arithmetic),
    /// One position of a sweep: the drawing transcribed beforehand, its places exact.
    Transcribed,
    /// A table of so many equal steps over the range of the input, read between two rows by a straight line,
    /// at the worst place: midway.
    Steps(u32),
    /// A table as dense as it takes to stray by no more than this part of a column's range.
    Tolerance(f64),
    /// Pencil, ruler and set square.
    ByHand(Hand),
    /// The independent solver; Newton's iteration ends where no equation misses by more than this part of
    /// the mechanism's size. Zero: at rounding.
    Analytic(f64),
}

impl Setting {
    /// All settings of the comparison.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let hand = |length: f64, degrees: f64| Self::ByHand(Hand { length, angle: degrees.to_radians() });
        let arithmetics = [Arithmetic::Single, Arithmetic::Double, Arithmetic::DoubleDouble];
        let mut all = vec![hand(0.5, 1.0), hand(0.2, 0.3), hand(0.05, 0.1)];
        all.extend([36, 360, 3600].map(Self::Steps));
        all.extend([1e-2, 1e-4].map(Self::Tolerance));
        all.push(Self::Transcribed);
        all.extend(arithmetics.map(Self::Unrecorded));
        all.extend(arithmetics.map(Self::Drawn));
        all.extend([1e-3, 1e-6, 0.0].map(Self::Analytic));
        all
    }

    /// Its name in the table.
    #[must_use]
    pub fn name(&self) -> String {
        let short = |a: &Arithmetic| match a {
            Arithmetic::Single => "f32",
            Arithmetic::Double => "f64",
            Arithmetic::DoubleDouble => "dd",
            Arithmetic::Wide => "75 digits",
        };
        match self {
            Self::Drawn(a) => format!("drawn, {}, recorded", short(a)),
            Self::Unrecorded(a) => format!("drawn, {}, no record", short(a)),
            Self::Transcribed => "sweep, one position".to_owned(),
            Self::Steps(n) => format!("sweep, {n} steps"),
            Self::Tolerance(t) => format!("sweep, tolerance {} %", t * 100.0),
            Self::ByHand(hand) => {
                format!("hand, {} mm {:.1}°", hand.length, hand.angle.to_degrees())
            }
            Self::Analytic(0.0) => "analytic, to rounding".to_owned(),
            Self::Analytic(t) => format!("analytic, Newton to {t:e}"),
        }
    }
}

/// Median and spread of something measured many times.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// The middle one.
    pub median: f64,
    /// One of ten is below.
    pub low: f64,
    /// One of ten is above.
    pub high: f64,
    /// The greatest.
    pub most: f64,
}

impl Spread {
    fn of(mut values: Vec<f64>) -> Option<Self> {
        values.sort_by(f64::total_cmp);
        let at = |tenths: usize| values.get((values.len().checked_sub(1)?) * tenths / 10).copied();
        Some(Self { median: at(5)?, low: at(1)?, high: at(9)?, most: at(10)? })
    }
}

/// What one setting costs and how wrong it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// The setting.
    pub setting: Setting,
    /// Seconds for all asked quantities of a scene, the mean over the scenes; its spread over the passes. A table
    /// counts as a whole, a hand for one draughtsman's drawing. `None` where no scene could be solved so.
    pub seconds: Option<Spread>,
    /// Errors of all quantities of all scenes, as parts of the largest asked value of their unit.
    pub errors: Option<Spread>,
    /// Stated bounds over true errors, where the setting states bounds and there is an error.
    pub caution: Option<Spread>,
    /// Errors beyond their bounds: always zero, or the program is wrong.
    pub beyond: usize,
    /// Quantities without an answer in this setting.
    pub refused: usize,
}

/// Why a scene is left out.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Unmeasured {
    /// It has no solution.
    #[error(transparent)]
    Solve(#[from] SolveError),
    /// Nothing that it asks for has a reference of fifty digits.
    #[error("nothing that it asks for is known to fifty digits here")]
    NoReference,
}

/// The least number of digits of a reference.
const DIGITS: f64 = 1e-50;
/// Draughtsmen for each hand.
const DRAUGHTSMEN: u64 = 100;
/// A setting is repeated within a pass until this many seconds have gone by.
const LEAST_SECONDS: f64 = 5e-4;

/// One asked quantity to be measured: its number is known.
struct Truth {
    /// Index among the asked.
    index: usize,
    value: Vec<Wide>,
    /// Largest asked value of the same unit.
    size: f64,
    /// An angle, which counts around the circle.
    turns: bool,
}

/// A scene made ready: all that is the same for every setting.
struct Subject<'s> {
    scene: &'s Scene,
    structure: Structure,
    plan: Plan,
    scales: Scales,
    truths: Vec<Truth>,
    sweep: Result<Sweep, SweepError>,
}

/// Numbers of one asked quantity by a setting, as far as it has them.
struct Answered {
    value: Vec<Wide>,
    bound: Option<f64>,
}

type Answers = Vec<Option<Answered>>;

fn length(values: &[Wide]) -> f64 {
    values.iter().fold(0.0, |sum, v| libm::hypot(sum, v.to_f64()))
}

fn answered<R: Real>(numbers: Vec<Option<Numbers<R>>>) -> Answers {
    let wide = |value: R| Wide::of_double_double(value.to_double_double());
    let one = |n: Numbers<R>| Answered { value: n.value.into_iter().map(wide).collect(), bound: n.bound };
    numbers.into_iter().map(|n| n.map(one)).collect()
}

impl<'s> Subject<'s> {
    fn new(scene: &'s Scene, choose: impl Fn(&Scene, Extents) -> Scales) -> Result<Self, Unmeasured> {
        let solved = solve::solve_with(scene, Extent::Asked, &[], Settings::default(), choose)?;
        let solve::Solved { structure, plan, scales, .. } = solved;
        let reference = graphical::recorded::<Wide>(&scene.mechanism, &structure, &plan, scales);
        let reference = reference.map_err(SolveError::from)?;
        let asked = &scene.mechanism.asked;
        let mut truths = Vec::new();
        for (index, numbers) in reference.iter().enumerate() {
            let Some(Numbers { value, bound: Some(bound) }) = numbers else { continue };
            let unit = &asked[index].unit.symbol;
            let same = asked.iter().zip(&reference).filter(|(a, _)| a.unit.symbol == *unit);
            let sizes = same.filter_map(|(_, n)| n.as_ref().map(|n| length(&n.value)));
            let size = sizes.fold(0.0, f64::max);
            if *bound <= DIGITS * size {
                let turns = matches!(asked[index].quantity, Quantity::Angle(_));
                truths.push(Truth { index, value: value.clone(), size, turns });
            }
        }
        if truths.is_empty() {
            return Err(Unmeasured::NoReference);
        }
        let sweep = Sweep::new(&scene.mechanism, None);
        Ok(Self { scene, structure, plan, scales, truths, sweep })
    }

    fn unrecorded<R: Real>(&self) -> Result<Vec<Option<Numbers<R>>>, DrawError> {
        graphical::unrecorded(&self.scene.mechanism, &self.structure, &self.plan, self.scales)
    }

    fn recorded<R: Real>(&self) -> Result<Vec<Option<Numbers<R>>>, DrawError> {
        graphical::recorded(&self.scene.mechanism, &self.structure, &self.plan, self.scales)
    }

    /// The answers of a setting; `seed` chooses the draughtsman.
    fn answers(&self, setting: Setting, seed: u64) -> Option<Answers> {
        let m = &self.scene.mechanism;
        Some(match setting {
            Setting::Drawn(Arithmetic::Single) => answered(self.recorded::<f32>().ok()?),
            Setting::Drawn(Arithmetic::Double) => answered(self.recorded::<f64>().ok()?),
            Setting::Drawn(Arithmetic::DoubleDouble) => answered(self.recorded::<DoubleDouble>().ok()?),
            Setting::Drawn(Arithmetic::Wide) => answered(self.recorded::<Wide>().ok()?),
            Setting::Unrecorded(Arithmetic::Single) => answered(self.unrecorded::<f32>().ok()?),
            Setting::Unrecorded(Arithmetic::Double) => answered(self.unrecorded::<f64>().ok()?),
            Setting::Unrecorded(Arithmetic::DoubleDouble) => {
                answered(self.unrecorded::<DoubleDouble>().ok()?)
            }
            Setting::Unrecorded(Arithmetic::Wide) => answered(self.unrecorded::<Wide>().ok()?),
            Setting::ByHand(hand) => {
                let drawn = graphical::by_one_hand(m, &self.structure, &self.plan, self.scales, (hand, seed));
                answered(drawn.ok()?)
            }
            Setting::Analytic(tolerance) => {
                let order = m.asked.iter().map(|a| a.quantity.order()).max().unwrap_or(Order::Position);
                let state = analytic::solve_within(m, order, tolerance).ok()?;
                let read = |quantity: &Quantity| match state.answer(quantity) {
                    Answer::Scalar { value, bound } => {
                        Some(Answered { value: vec![Wide::of(value)], bound: Some(bound) })
                    }
                    Answer::Vector { value, bound } => {
                        Some(Answered { value: value.map(Wide::of).to_vec(), bound: Some(bound) })
                    }
                    Answer::AtInfinity { .. } | Answer::Indeterminate(_) => None,
                };
                m.asked.iter().map(|a| read(&a.quantity)).collect()
            }
            Setting::Transcribed => self.between([self.sweep.as_ref().ok()?.start; 2])?,
            Setting::Steps(steps) => {
                let sweep = self.sweep.as_ref().ok()?;
                let half = (sweep.range[1] - sweep.range[0]) / f64::from(steps) / 2.0;
                self.between([sweep.start - half, sweep.start + half])?
            }
            Setting::Tolerance(tolerance) => {
                let sweep = self.sweep.as_ref().ok()?;
                let places = sweep.adapted(tolerance);
                let after = places.partition_point(|p| *p < sweep.start);
                let next = *places.get(after)?;
                self.between([after.checked_sub(1).map_or(next, |i| places[i]), next])?
            }
        })
    }

    /// The sweep's numbers at the scene's place, by a straight line between two others.
    fn between(&self, ends: [f64; 2]) -> Option<Answers> {
        let sweep = self.sweep.as_ref().ok()?;
        let within = ends.map(|at| at.clamp(sweep.range[0], sweep.range[1]));
        let [before, after] = [sweep.at(within[0])?, sweep.at(within[1])?];
        let width = within[1] - within[0];
        let part = if width > 0.0 { (sweep.start - within[0]) / width } else { 0.0 };
        let number = |column: usize| -> Option<Wide> {
            let (a, b) = (before[column]?.value, after[column]?.value);
            Some(Wide::of(a + part * (b - a)))
        };
        let columns = |name: &str| -> Option<Vec<Wide>> {
            let of_it = sweep.columns.iter().enumerate().filter(|(_, c)| !c.watched && c.asked.name == name);
            of_it.map(|(index, _)| number(index)).collect()
        };
        let asked = &self.scene.mechanism.asked;
        let answer = |value: Vec<Wide>| (!value.is_empty()).then_some(Answered { value, bound: None });
        Some(asked.iter().map(|a| answer(columns(&a.name)?)).collect())
    }

    /// Does what a setting does, for its time only; `false` where it cannot.
    fn run(&self, setting: Setting) -> bool {
        match (setting, &self.sweep) {
            (Setting::Transcribed | Setting::Steps(_) | Setting::Tolerance(_), Err(_)) => false,
            (Setting::Transcribed, Ok(sweep)) => {
                tabulate(sweep, &[sweep.start; crate::board::LANES]);
                true
            }
            (Setting::Steps(steps), Ok(sweep)) => {
                tabulate(sweep, &sweep.equal_steps(steps));
                true
            }
            (Setting::Tolerance(tolerance), Ok(sweep)) => {
                tabulate(sweep, &sweep.adapted(tolerance));
                true
            }
            _ => self.answers(setting, 1).is_some_and(|answers| black_box(answers).len() < usize::MAX),
        }
    }

    /// Seconds of one run, over as many as it takes to tell.
    fn seconds(&self, setting: Setting, repetitions: u32) -> f64 {
        let start = Instant::now();
        for _ in 0..repetitions {
            self.run(setting);
        }
        let lanes = match setting {
            // A sweep computes so many positions at a time.
            Setting::Transcribed => crate::board::LANES as f64,
            _ => 1.0,
        };
        start.elapsed().as_secs_f64() / f64::from(repetitions) / lanes
    }
}

fn tabulate(sweep: &Sweep, places: &[f64]) {
    let mut sum = 0.0;
    sweep.run(places, |_, values| sum += values.last().copied().unwrap_or(0.0));
    black_box(sum);
}

/// Errors and refusals of one setting.
#[derive(Default)]
struct Tally {
    errors: Vec<f64>,
    cautions: Vec<f64>,
    beyond: usize,
    refused: usize,
}

impl Tally {
    fn count(&mut self, truths: &[Truth], answers: Option<&Answers>) {
        for truth in truths {
            let answer = answers.and_then(|a| a.get(truth.index)).and_then(Option::as_ref);
            let Some(answer) = answer.filter(|a| a.value.len() == truth.value.len()) else {
                self.refused += 1;
                continue;
            };
            let apart: Vec<Wide> = answer.value.iter().zip(&truth.value).map(|(a, t)| *a - *t).collect();
            let mut error = length(&apart);
            if truth.turns {
                error = error.min((error - 2.0 * std::f64::consts::PI).abs());
            }
            self.errors.push(error / truth.size);
            if let Some(bound) = answer.bound {
                self.beyond += usize::from(error > bound);
                if error > 0.0 {
                    self.cautions.push(bound / error);
                }
            }
        }
    }
}

/// A measured comparison.
#[derive(Debug, Clone, PartialEq)]
pub struct Tradeoff {
    /// One row per setting.
    pub outcomes: Vec<Outcome>,
    /// How many quantities have a reference.
    pub quantities: usize,
    /// How many scenes were measured.
    pub scenes: usize,
    /// Scenes that were not: their index and why.
    pub left_out: Vec<(usize, Unmeasured)>,
}

/// Measures all settings on some scenes, `passes` times one after the other; `tick` is called after each setting
/// of each pass.
pub fn measure(
    scenes: &[Scene],
    passes: usize,
    choose: impl Fn(&Scene, Extents) -> Scales,
    mut tick: impl FnMut(),
) -> Tradeoff {
    let mut subjects = Vec::new();
    let mut left_out = Vec::new();
    for (index, scene) in scenes.iter().enumerate() {
        match Subject::new(scene, &choose) {
            Ok(subject) => subjects.push(subject),
            Err(why) => left_out.push((index, why)),
        }
    }
    let settings = Setting::all();
    let mut tallies: Vec<Tally> = Vec::new();
    let mut runs: Vec<Vec<(&Subject<'_>, u32)>> = Vec::new();
    for &setting in &settings {
        let mut tally = Tally::default();
        let mut able = Vec::new();
        for subject in &subjects {
            let draughtsmen = if matches!(setting, Setting::ByHand(_)) { DRAUGHTSMEN } else { 1 };
            for seed in 0..draughtsmen {
                tally.count(&subject.truths, subject.answers(setting, seed).as_ref());
            }
            if subject.run(setting) {
                let once = subject.seconds(setting, 1).max(1e-9);
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 10⁵")]
                able.push((subject, (LEAST_SECONDS / once).clamp(1.0, 1e5).ceil() as u32));
            }
        }
        tallies.push(tally);
        runs.push(able);
    }
    // Settings take turns, so that a busy moment of the machine meets all of them.
    let mut seconds = vec![Vec::with_capacity(passes); settings.len()];
    for _ in 0..passes {
        for ((setting, able), times) in settings.iter().zip(&runs).zip(&mut seconds) {
            if !able.is_empty() {
                let all: f64 = able.iter().map(|(s, repetitions)| s.seconds(*setting, *repetitions)).sum();
                times.push(all / able.len() as f64);
            }
            tick();
        }
    }
    let outcomes =
        settings.into_iter().zip(tallies).zip(seconds).map(|((setting, tally), seconds)| Outcome {
            setting,
            seconds: Spread::of(seconds),
            errors: Spread::of(tally.errors),
            caution: Spread::of(tally.cautions),
            beyond: tally.beyond,
            refused: tally.refused,
        });
    Tradeoff {
        outcomes: outcomes.collect(),
        quantities: subjects.iter().map(|s| s.truths.len()).sum(),
        scenes: subjects.len(),
        left_out,
    }
}
