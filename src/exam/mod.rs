//! Variants of a scene for an examination: the same question with other numbers, its answers with their
//! tolerances, and question banks.
//!
//! Tries are numbered. What a try draws depends on the seed and its number, whether it may become a variant on
//! nothing but itself, and the variants are the first tries that may and that differ from every variant before
//! them, in most answers as long as such are found: neither the number of workers nor how many variants are wanted
//! changes any of them.
//!
//! **Architecture Invariant:** no number is computed here. Variants are scenes, solved as every scene is; what an
//! answer may be off is the error of the draughtsman's hand.

mod admission;
mod answer;
mod bank;
mod dice;
mod key;
mod measured;
mod moodle;
mod qti;

use std::collections::{BTreeMap, VecDeque};
use std::fmt;

pub use answer::KeyAnswer;
pub(crate) use answer::{share_of_opposite, share_without_direction};
pub use bank::Bank;
pub use key::{answers_csv, csv, json};
pub use moodle::{cloze, numerical};
pub use qti::{QtiError, package};

use crate::board::Hand;
use crate::check::{NotConfirmed, Unconfirmed, solve_confirmed};
use crate::drawing::{self, Drawing, Kind, with_what_is_missing};
use crate::graphical::Scales;
use crate::graphical::construction::Construction;
use crate::parallel;
use crate::plan::Extent;
use crate::scene::Scene;
use crate::sheet::{self, Figure, Language};
use crate::solve::{Settings, SolveError, solve_with};
use admission::{Base, Candidate};
use dice::Tries;

/// So many tries without a new variant, and no more are looked for.
const PATIENCE: u64 = 1000;
/// So many tries without one that differs from every variant in most answers, and none is chosen any more.
const CHOOSING: u64 = 64;
/// So many tries are looked at together; a fixed number, so that the same tries are made by any number of
/// workers.
const TOGETHER: u64 = 32;

/// What variants are wanted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Terms {
    /// How many.
    pub variants: usize,
    /// The seed of the dice.
    pub seed: u64,
    /// No two lines or arcs of a variant's solution cross at a smaller angle, radians.
    pub flattest: f64,
    /// The hand of the students, by which the tolerances are found.
    pub hand: Hand,
    /// No tolerance is a larger part of its value.
    pub max_tolerance: f64,
    /// What becomes of answers that a careful hand may miss by more.
    pub loose: Loose,
}

/// What becomes of an answer that a careful hand may miss by more than is allowed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Loose {
    /// Such a variant is passed over: nobody is asked what he cannot measure.
    #[default]
    PassOver,
    /// What is so in the scene itself is not asked, and other variants where it is so are passed over.
    LeaveOut,
    /// It is asked all the same, and the key says which it is.
    Ask,
}

impl Loose {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::PassOver, Self::LeaveOut, Self::Ask];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::PassOver => "pass-over",
            Self::LeaveOut => "leave-out",
            Self::Ask => "ask",
        }
    }

    /// That of a name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|loose| loose.name() == name)
    }
}

/// The scene without what a careful hand may miss by more than is allowed, and the names of that; `None` where there is
/// nothing of it.
///
/// # Errors
/// [`ExamError::NothingLeft`], or the scene's own refusal.
pub fn without_loose(scene: &Scene, terms: &Terms) -> Result<Option<(Scene, Vec<String>)>, ExamError> {
    let loose = admission::loose(scene, terms)?;
    if loose.is_empty() {
        return Ok(None);
    }
    if loose.len() == scene.mechanism.asked.len() {
        return Err(ExamError::NothingLeft);
    }
    let names: Vec<String> = loose.iter().map(|&place| scene.mechanism.asked[place].name.clone()).collect();
    let text = crate::scene::asking_less(scene, &names);
    let less =
        crate::scene::read(&text, scene.source.file()).map_err(|error| ExamError::Less(Box::new(error)))?;
    Ok(Some((less, names)))
}

/// A variant of the scene.
#[derive(Debug, Clone)]
pub struct Variant {
    /// Its number, from 1.
    pub number: usize,
    /// The number of the try that it came from.
    pub attempt: u64,
    /// The numbers that it has, in the order of [`Scene::vary`].
    pub numbers: Vec<String>,
    /// Its text, a scene of its own.
    pub text: String,
    /// The same, read.
    pub scene: Scene,
    /// The numbers to be handed in, in the order of what is asked.
    pub answers: Vec<KeyAnswer>,
}

impl Variant {
    /// Its number as files and titles have it: `007`.
    #[must_use]
    pub fn name(&self) -> String {
        name(self.number)
    }
}

fn name(number: usize) -> String {
    format!("{number:03}")
}

/// Why a try did not become a variant.
#[derive(Debug, Clone, PartialEq)]
pub enum Flaw {
    /// The numbers contradict each other or the scene's rules.
    NoScene {
        /// What the reader said.
        what: String,
    },
    /// The chain does not close.
    CannotAssemble,
    /// It cannot be led from the scene's position into this one without passing a dead centre.
    OtherAssembly,
    /// Two construction lines or arcs cross too flatly; at a dead centre they touch.
    Flat {
        /// Angle of the flattest crossing.
        degrees: f64,
    },
    /// An asked quantity has no number here.
    Undetermined {
        /// Its name.
        name: String,
    },
    /// Not every careful draughtsman gets an answer: some lines or arcs miss each other.
    NotByHand {
        /// The name of the quantity.
        name: String,
    },
    /// An answer is not clear of the slip of a careful hand, though that of the scene is.
    Drowned {
        /// The name of the quantity.
        name: String,
    },
    /// A careful hand may be off by more than is allowed.
    Loose {
        /// The name of the quantity.
        name: String,
    },
    /// An arm or a side of a force polygon is too short to be measured, though it is not in the scene.
    Short {
        /// Which.
        what: String,
        /// How long it is on paper, mm.
        mm: f64,
    },
    /// A pair that rubs moves in another sense than in the scene.
    OtherSense {
        /// Which.
        what: String,
    },
    /// An asked instant centre lies off the paper, though it does not in the scene.
    FarCentre {
        /// Its name.
        name: String,
    },
    /// At the stated scales it is larger than the paper.
    OffPage,
    /// The two solvers do not agree within their bounds.
    Disagrees,
    /// All its answers lie within the tolerance of another variant's.
    Alike {
        /// The number of the other variant.
        variant: usize,
    },
}

impl Flaw {
    /// The kind of it, as a tally counts it.
    fn kind(&self) -> &'static str {
        match self {
            Self::NoScene { .. } => "are no scene",
            Self::CannotAssemble => "cannot be assembled",
            Self::OtherAssembly => "are assembled in another way, or lie behind a dead centre",
            Self::Flat { .. } => "have too flat a crossing",
            Self::Undetermined { .. } => "leave an asked quantity undetermined",
            Self::NotByHand { .. } => "cannot be drawn by every careful hand",
            Self::Drowned { .. } => "have an answer within the slip of a careful hand",
            Self::Loose { .. } => "have an answer that a careful hand may miss by more than is allowed",
            Self::Short { .. } => "have a length of the forces that is too short to be measured",
            Self::OtherSense { .. } => "have a pair that rubs the other way",
            Self::FarCentre { .. } => "have an instant centre off the page",
            Self::OffPage => "do not fit the page at the stated scales",
            Self::Disagrees => "are not confirmed by the analytic solver",
            Self::Alike { .. } => "have the answers of another variant, within tolerance",
        }
    }

    /// What it was in this case, where the kind does not say all.
    fn detail(&self) -> Option<String> {
        match self {
            Self::NoScene { what } => Some(what.clone()),
            Self::Flat { degrees } => Some(format!("{degrees:.1}°")),
            Self::Undetermined { name }
            | Self::NotByHand { name }
            | Self::Drowned { name }
            | Self::Loose { name }
            | Self::FarCentre { name } => Some(name.clone()),
            Self::Short { what, mm } => Some(format!("{what}, {mm:.1} mm")),
            Self::OtherSense { what } => Some(what.clone()),
            Self::Alike { variant } => Some(format!("variant {}", name(*variant))),
            Self::CannotAssemble | Self::OtherAssembly | Self::OffPage | Self::Disagrees => None,
        }
    }
}

/// How many tries failed on what, with the first case of each.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Tally {
    /// Number of failed tries and the first flaw, by kind.
    pub flaws: BTreeMap<&'static str, (u64, Flaw)>,
}

impl Tally {
    fn count(&mut self, flaw: Flaw) {
        self.flaws.entry(flaw.kind()).or_insert((0, flaw)).0 += 1;
    }

    /// Whether some failed on an answer that a careful hand may miss by more than is allowed.
    #[must_use]
    pub fn has_loose(&self) -> bool {
        self.flaws.values().any(|(_, flaw)| matches!(flaw, Flaw::Loose { .. }))
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut flaws: Vec<_> = self.flaws.iter().collect();
        flaws.sort_by_key(|(_, (count, _))| std::cmp::Reverse(*count));
        for (index, (kind, (count, flaw))) in flaws.into_iter().enumerate() {
            let between = if index > 0 { ", " } else { "" };
            write!(f, "{between}{count} {kind}")?;
            if let Some(detail) = flaw.detail() {
                write!(f, " (first: {detail})")?;
            }
        }
        Ok(())
    }
}

/// The variants, and what was passed over on the way to the last of them.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// The variants, in the order of their numbers.
    pub variants: Vec<Variant>,
    /// How many tries it took.
    pub tries: u64,
    /// What the others failed on.
    pub tally: Tally,
}

/// Why there are no variants.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExamError {
    /// The scene has no `vary`.
    #[error("nothing varies")]
    NothingVaries,
    /// The scene itself cannot be solved.
    #[error(transparent)]
    Scene(#[from] SolveError),
    /// The independent solver does not confirm the scene's own solution.
    #[error(transparent)]
    Unconfirmed(#[from] Unconfirmed),
    /// A careful hand may miss all that is asked by more than is allowed.
    #[error("a careful hand may miss all that is asked by more than is allowed")]
    NothingLeft,
    /// Without what is loose the scene is none.
    #[error("without what a careful hand may miss: {0}")]
    Less(Box<crate::scene::Diagnostic>),
    /// The ranges give fewer scenes than there should be variants.
    #[error("the ranges give {possible} different scenes, fewer than the {wanted} variants wanted")]
    TooFew {
        /// How many they give.
        possible: u64,
        /// How many are wanted.
        wanted: usize,
    },
    /// Too few of the tries may become variants.
    #[error("{found} of {wanted} variants after {tries} tries{}: {tally}", if *.all { ", which are all that the ranges give" } else { "" })]
    Exhausted {
        /// Variants found.
        found: usize,
        /// Variants wanted.
        wanted: usize,
        /// Tries made.
        tries: u64,
        /// Whether these were all different scenes that the ranges give.
        all: bool,
        /// What the others failed on.
        tally: Tally,
    },
}

/// Draws the variants of a scene. `progress` is told how many there are, whenever there are more.
///
/// # Errors
/// See [`ExamError`].
pub fn draw(
    scene: &Scene,
    terms: &Terms,
    workers: usize,
    progress: &dyn Fn(usize),
) -> Result<Drawn, ExamError> {
    if scene.vary.is_empty() {
        return Err(ExamError::NothingVaries);
    }
    let tries = Tries::new(&scene.vary, terms.seed);
    if let Some(possible) = tries.all().filter(|all| usize::try_from(*all).is_ok_and(|n| n < terms.variants))
    {
        return Err(ExamError::TooFew { possible, wanted: terms.variants });
    }
    let base = Base::new(scene, terms)?;
    let mut drawn = Drawn { variants: Vec::new(), tries: 0, tally: Tally::default() };
    let mut last_success = 0;
    // Neighbours could copy from each other where most answers are alike: such tries wait, as long as there are others.
    let mut waiting: VecDeque<(Vec<String>, u64, Candidate)> = VecDeque::new();
    let mut choosy = true;
    loop {
        let batch: Vec<Vec<String>> = (drawn.tries..drawn.tries + TOGETHER)
            .map_while(|attempt| tries.indices(attempt))
            .map(|indices| scene.vary.iter().zip(indices).map(|(v, i)| v.range.number(i)).collect())
            .collect();
        let all = batch.is_empty();
        let judged = parallel::map_with(workers, &batch, |numbers| base.admit(numbers, terms));
        for (numbers, judged) in batch.into_iter().zip(judged) {
            if drawn.variants.len() == terms.variants {
                break;
            }
            let attempt = drawn.tries;
            drawn.tries += 1;
            match judged.and_then(|candidate| unlike(&drawn.variants, candidate)) {
                Err(flaw) => drawn.tally.count(flaw),
                Ok(candidate) if choosy && mostly_alike(&drawn.variants, &candidate) => {
                    waiting.push_back((numbers, attempt, candidate));
                }
                Ok(candidate) => {
                    take(&base, &mut drawn, (numbers, attempt), candidate);
                    last_success = drawn.tries;
                    progress(drawn.variants.len());
                }
            }
            choosy = choosy && drawn.tries - last_success < CHOOSING;
            if !choosy && !waiting.is_empty() {
                end_waiting(&base, &mut drawn, &mut waiting, terms.variants);
                last_success = drawn.tries;
                progress(drawn.variants.len());
            }
        }
        if all {
            end_waiting(&base, &mut drawn, &mut waiting, terms.variants);
        }
        let (found, wanted) = (drawn.variants.len(), terms.variants);
        if found == wanted {
            return Ok(drawn);
        }
        if all || drawn.tries - last_success >= PATIENCE {
            let all = tries.all() == Some(drawn.tries);
            return Err(ExamError::Exhausted { found, wanted, tries: drawn.tries, all, tally: drawn.tally });
        }
    }
}

/// A candidate that waited becomes a variant, unless one that came before it has its answers.
fn take(base: &Base<'_>, drawn: &mut Drawn, (numbers, attempt): (Vec<String>, u64), candidate: Candidate) {
    match unlike(&drawn.variants, candidate) {
        Err(flaw) => drawn.tally.count(flaw),
        Ok(candidate) => {
            let number = drawn.variants.len() + 1;
            drawn.variants.push(base.named(numbers, number, attempt, candidate));
        }
    }
}

/// Those that waited become variants, in the order of their tries, as long as some are wanted.
fn end_waiting(
    base: &Base<'_>,
    drawn: &mut Drawn,
    waiting: &mut VecDeque<(Vec<String>, u64, Candidate)>,
    wanted: usize,
) {
    while drawn.variants.len() < wanted {
        let Some((numbers, attempt, candidate)) = waiting.pop_front() else { break };
        take(base, drawn, (numbers, attempt), candidate);
    }
}

/// Whether more than half of a candidate's answers are those of one of the variants, within tolerance.
fn mostly_alike(variants: &[Variant], candidate: &Candidate) -> bool {
    variants.iter().any(|variant| {
        let pairs = variant.answers.iter().zip(&candidate.answers);
        2 * pairs.filter(|(a, b)| a.alike(b)).count() > candidate.answers.len()
    })
}

/// The variants that came from these tries of an earlier [`draw`] by the same terms.
///
/// # Errors
/// The scene's own refusal. `None` in the place of the variants where one of the tries does not give a variant:
/// then they are not those of such a draw.
pub fn redraw(
    scene: &Scene,
    terms: &Terms,
    attempts: &[u64],
    workers: usize,
    progress: &(dyn Fn() + Sync),
) -> Result<Option<Vec<Variant>>, ExamError> {
    let tries = Tries::new(&scene.vary, terms.seed);
    let base = Base::new(scene, terms)?;
    let numbered: Vec<(usize, u64)> = (1..).zip(attempts.iter().copied()).collect();
    let variants = parallel::map_with(workers, &numbered, |(number, attempt)| {
        let indices = tries.indices(*attempt)?;
        let numbers: Vec<String> = scene.vary.iter().zip(indices).map(|(v, i)| v.range.number(i)).collect();
        let candidate = base.admit(&numbers, terms).ok()?;
        progress();
        Some(base.named(numbers, *number, *attempt, candidate))
    });
    Ok(variants.into_iter().collect())
}

/// A candidate that differs from every variant by more than the tolerance in one answer at least.
fn unlike(variants: &[Variant], candidate: Candidate) -> Result<Candidate, Flaw> {
    let same = |variant: &&Variant| {
        let pairs = variant.answers.iter().zip(&candidate.answers);
        variant.answers.len() == candidate.answers.len() && pairs.clone().all(|(a, b)| a.alike(b))
    };
    match variants.iter().find(same) {
        Some(variant) => Err(Flaw::Alike { variant: variant.number }),
        None => Ok(candidate),
    }
}

/// A sheet of a variant, at scales at which it fits its paper. Nothing that the independent solver does not confirm is
/// written.
fn on_paper(
    scene: &Scene,
    kind: Kind,
    language: Language,
    compose: impl Fn(&Construction) -> Figure,
) -> Result<Figure, NotConfirmed> {
    let of_page = match kind {
        Kind::Question => sheet::scale::for_question,
        _ => sheet::scale::for_scene,
    };
    let draw = |scales: Option<Scales>| {
        let choose = |scene: &Scene, extents| scales.unwrap_or_else(|| of_page(scene, extents));
        let solved = solve_with(scene, Extent::WholeSkeleton, &[], Settings::default(), choose)?;
        Drawing::of(scene, solved, |solved| Ok::<_, NotConfirmed>(compose(&solved.solution.construction)))
    };
    let drawing = drawing::on_its_paper(scene, kind, draw(None)?, |scales| draw(Some(scales)))?;
    drawing.confirmed?;
    Ok(with_what_is_missing(drawing.figure, scene, &drawing.solved, language))
}

/// The question of a variant: what is given, the dimensioned skeleton, what is asked, how directions are counted and what
/// each answer is worth.
///
/// # Errors
/// None for a scene that was drawn as a variant.
pub fn question(scene: &Scene, language: Language) -> Result<Figure, NotConfirmed> {
    on_paper(scene, Kind::Question, language, |construction| {
        sheet::question_of_exam(scene, construction, language, &answer::marked(scene, construction))
    })
}

/// The same as a card, for the figure of a question on a screen.
///
/// # Errors
/// None for a scene that was drawn as a variant.
pub fn card(scene: &Scene, language: Language) -> Result<Figure, NotConfirmed> {
    let solved =
        solve_confirmed(scene, Extent::WholeSkeleton, &[], Settings::default(), sheet::scale::for_question)?;
    let figure = sheet::question_card(scene, &solved.solution.construction, language);
    Ok(with_what_is_missing(figure, scene, &solved, language))
}

/// The solution of a variant.
///
/// # Errors
/// None for a scene that was drawn as a variant.
pub fn solution(scene: &Scene, language: Language) -> Result<Figure, NotConfirmed> {
    on_paper(scene, Kind::Solution, language, |construction| sheet::solution(scene, construction, language))
}

/// The sheet on which students write their answers, a box for every number of the key; it is the same for all variants.
#[must_use]
pub fn form(scene: &Scene, variant: &Variant, language: Language) -> Figure {
    let asked = &variant.scene.mechanism.asked;
    let numbers: Vec<_> = variant
        .answers
        .iter()
        .filter_map(|answer| Some((asked.get(answer.asked)?, answer.part, answer.unit.clone())))
        .collect();
    sheet::answer_form(scene, &numbers, language)
}
