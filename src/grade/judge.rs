//! Which answers are right, which follow rightly from a wrong one, and which mistake explains the rest.
//!
//! Answers are taken in the order of the solution. At the first one that neither is right nor follows from what is
//! known of the drawing so far, every typical mistake is tried as a changed construction; the one that explains the
//! answers best, counted together, becomes part of what is known. Where none does, the student's own value takes
//! its place in the construction, and it is seen what follows from it.

use super::answers::Given;
use super::case::{Case, Observation, Room, Target, WIDE, size};
use super::change::{Change, InputChange, Misreading, Which};
use super::fitted;
use super::kind::Kind;
use super::misread;
use super::mistakes::{self, Hypothesis, vector_of};
use super::phrase::{Phrase, say};
use super::routes;
use super::steps::{self, By};
use crate::graphical::construction::{Act, Calculation, Label, Vector};
use crate::graphical::{Departure, Sketch, Twist};
use crate::mechanism::force::{Action, Force, Share};
use crate::mechanism::quantity::{Order, Quantity};

/// What is said of one answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Verdict {
    /// Within its tolerance.
    Right,
    /// Wrong, but it follows rightly from an earlier wrong answer.
    Consistent,
    /// Wrong.
    Wrong,
    /// Nothing can be said: the quantity is not determined here.
    NotChecked,
}

/// A mistake that explains answers.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// Which.
    pub kind: Kind,
    /// What it is about, such as `an(B/A)`.
    pub at: Phrase,
    /// In which step of the solution it was made, from 1, where that can be said.
    pub step: Option<usize>,
    /// What exactly was done, where kind and place do not say it: `bc read for oc`.
    pub how: Option<Phrase>,
    /// How far the explained answers are from what the mistake leads to: root of the mean square, in tolerances.
    pub residual: f64,
    /// How many answers it explains that are not right.
    pub explains: usize,
    /// The mistake that was made beside it, where only both together explain the answers.
    pub also: Option<Box<Mistake>>,
}

impl Mistake {
    /// The mistake, and the one that was made beside it.
    pub fn parts(&self) -> impl Iterator<Item = &Self> {
        [self].into_iter().chain(self.also.as_deref())
    }
}

/// One fault: where it starts, and what it may be.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Fault {
    /// Index of the answer where it shows first.
    pub(super) first: usize,
    /// Ranked; empty where no known mistake fits.
    pub(super) mistakes: Vec<Mistake>,
}

impl Fault {
    /// Whether nothing explains it, or only what comes near.
    fn is_open(&self) -> bool {
        let close = |mistake: &Mistake| mistake.also.is_none() && mistake.residual <= CLOSE;
        !self.mistakes.first().is_some_and(close)
    }

    /// Whether what explains it leaves something out, so that other numbers may rightly be nothing.
    fn leaves_out(&self) -> bool {
        self.mistakes.first().is_some_and(|mistake| mistake.parts().any(|part| part.kind.leaves_out()))
    }
}

/// All that was found.
#[derive(Debug, Clone)]
pub(super) struct Judgement {
    pub(super) verdicts: Vec<Verdict>,
    pub(super) faults: Vec<Fault>,
    /// Of each answer that follows rightly from a wrong one, the latest fault before it.
    pub(super) caused: Vec<Option<usize>>,
    /// What the student drew, as far as it is known.
    pub(super) drawn: Change,
}

/// A miss of one tolerance is so many times its usual size.
const USUAL: f64 = 2.5;
/// A miss is not counted as more than this: the answer is then not explained at all.
const MOST: f64 = 25.0;
/// An answer is explained if it misses by no more than this many tolerances.
const EXPLAINED: f64 = 1.25;
/// What explains answers well misses them by no more than this, root of the mean square in tolerances.
pub(super) const CLOSE: f64 = 0.65;
/// A value of which nothing is known may be anything: that explains it, at this price.
const UNKNOWN: f64 = 12.0;
/// How many of the best hypotheses are weighed with tolerances of their own.
const WEIGHED: usize = 24;
/// Draughtsmen for the tolerances of one hypothesis.
const FEW: u64 = 24;
/// Two vectors are as long as each other within this part.
const AS_LONG: f64 = 0.05;
/// What leaves nothing of a vector leaves no larger part of its room.
const NOTHING: f64 = 0.01;
/// Whatever explains an answer brings it nearer by as many tolerances.
const MOVES: f64 = 0.1;
/// So many of the closest explanations are asked what follows from them by other ways.
const CREDITED: usize = 4;
/// By no more than this the answers speak for one of many explanations against one that has no choice.
const CHOICE: f64 = 4.0;
/// An answer that is right was not moved by so many of its rooms.
const MOVED: f64 = 2.0;
/// An answer that misses by no more than so many of its rooms may be a slip.
const HARDLY_MISSED: f64 = 2.0;
/// What meets all answers misses them by no more than this, root of the mean square in tolerances.
const MEETS_ALL: f64 = 0.85;
/// An answer that follows by another way costs an explanation no more than this.
const FOLLOWING: f64 = 3.0;
/// How many mistakes are named at one fault.
const NAMED: usize = 5;
/// Single mistakes that are tried together with every other one.
const PAIRED: usize = 6;
/// What a second mistake costs.
const SECOND: f64 = 8.0;

/// A given number that was misread is carried through so many wrong answers at least.
const CARRIED: usize = 3;
/// So many earlier answers, each in so many ways, take their places where a mistake may have been made after them.
const OWN: usize = 2;
/// After so many faults that nothing explains a student's numbers belong to no drawing.
const LOST: usize = 3;
/// What follows from such numbers is met within this part of its room.
const STRICT: f64 = 0.4;

/// What it costs that a number was handed in of what is said to be left out.
const NOT_LEFT_OUT: f64 = 3.0;

/// Of two mistakes that lead to the same numbers the one by which something was forgotten is the likelier one.
const FORGOTTEN: f64 = 0.05;

/// How much nearer a mistake is that is made at the answer that shows it.
const AT_HAND: f64 = 0.25;

/// By no more than this the answers speak for one of two explanations, as the squares of misses are counted: they do not
/// decide between them.
const UNDECIDED: f64 = 0.5;
/// What comes as near to answers misses them by no more than this beyond, root of the mean square in tolerances.
const AS_CLOSE: f64 = 0.1;

/// A careless hand slips by no more than this part of a number, and this many degrees.
pub(super) const SLIP: (f64, f64) = (0.12, 6.0);
/// What is named in the place of a slip leads this near, root of the mean square in tolerances.
const MET: f64 = 0.5;
/// The same of one of many lines, letters, lengths or formulas, one of which lies near any slip.
const MET_BY_ONE_OF_MANY: f64 = 0.15;
/// Or this near, where the answer hardly misses: as near as it is written, when it was calculated by that mistake.
const CALCULATED: f64 = 0.03;

/// How much a miss, in tolerances, counts.
fn square(miss: f64) -> f64 {
    (USUAL * miss) * (USUAL * miss)
}

/// A tried explanation.
#[derive(Clone)]
struct Tried {
    hypothesis: Hypothesis,
    change: Change,
    cost: f64,
    /// How much of it the answer that is to be explained costs.
    here: f64,
    /// Of every answer, in tolerances.
    misses: Vec<f64>,
    /// Of the answer that is to be explained, in tolerances of the right drawing.
    moved: f64,
}

/// Judges all answers; those `of_another` variant are right or wrong, for what they follow from is not this mechanism.
pub(super) fn judge(case: &Case<'_>, of_another: bool) -> Judgement {
    let count = case.observations.len();
    let right: Vec<f64> =
        (0..count).map(|i| case.miss(i, case.truth[i].as_deref(), case.accepted(i))).collect();
    let mut verdicts: Vec<Option<Verdict>> = (0..count)
        .map(|i| match (&case.truth[i], right[i] <= 1.0) {
            (None, _) => Some(Verdict::NotChecked),
            (_, true) => Some(Verdict::Right),
            _ => None,
        })
        .collect();
    let shown = (0..count).any(|i| verdicts[i] == Some(Verdict::Right) && !case.is_zero(i));
    let mut drawn = Change::default();
    let mut faults = Vec::new();
    let mut caused = vec![None; count];
    if of_another {
        let verdicts = verdicts.into_iter().map(|verdict| verdict.unwrap_or(Verdict::Wrong)).collect();
        return Judgement {
            verdicts,
            faults: Vec::new(),
            caused: vec![None; count],
            drawn: Change::default(),
        };
    }
    while let Some(first) = verdicts.iter().position(Option::is_none) {
        if routes::follows_from_right_numbers(case, &verdicts, first) {
            verdicts[first] = Some(Verdict::Right);
            continue;
        }
        // Numbers that belong to no drawing lead together near any number: what follows from them must be met, and only
        // by what has all of them.
        let lost = faults.iter().filter(|fault: &&Fault| fault.is_open()).count() >= LOST;
        let width = if lost { EXPLAINED * STRICT } else { EXPLAINED };
        if !faults.is_empty()
            && let Some(base) = case.drawn(&drawn, None)
        {
            let allowed = case.rooms[first].times(width);
            let by = if lost { By::AllTogether } else { By::Any };
            if routes::follows(case, (&drawn, &base), &verdicts, first, (allowed, by)) {
                verdicts[first] = Some(Verdict::Consistent);
                caused[first] = faults.len().checked_sub(1);
                continue;
            }
        }
        let unexplained = faults.iter().any(|fault: &Fault| fault.mistakes.is_empty());
        let judge = Judge { case, drawn: &drawn, verdicts: &verdicts, first, faults: &faults, unexplained };
        let (mut mistakes, mut change) = judge.explain();
        // What shows first may follow from an answer that the solution finds later.
        let cause = judge.cause(&change);
        if let Some(cause) = cause {
            (mistakes, change) = Judge { first: cause, ..judge }.explain();
        }
        let first = cause.unwrap_or(first);
        // The same mistake once more, of which the drawing did not show that it leads here as well.
        match faults.iter().position(|fault: &Fault| is_made_again(fault, &mistakes)) {
            Some(known) => {
                verdicts[first] = Some(Verdict::Consistent);
                caused[first] = Some(known);
            }
            None => {
                verdicts[first] = Some(Verdict::Wrong);
                faults.push(Fault { first, mistakes });
            }
        }
        drawn = change;
        // What follows rightly from the fault.
        let Some(sketch) = case.drawn(&drawn, None) else { continue };
        let seen = case.seen(&sketch, &drawn);
        let rooms = case.rooms_of(&drawn, &seen, FEW);
        let so_far = verdicts.clone();
        for (index, verdict) in verdicts.iter_mut().enumerate() {
            let Some(numbers) = seen[index].as_deref() else { continue };
            let most = case.most(index, numbers);
            let usual = case.rooms[index].of_size(size(numbers), case.right_size(index));
            let allowed = rooms[index].or(usual).times(EXPLAINED).and(most);
            let allowed = if lost { allowed.times(STRICT) } else { allowed };
            let known = faults.last().is_some_and(|fault| !fault.is_open());
            // A line may leave nothing of a vector: that is met by what is nothing, wherever it points.
            let vanishes = shown
                && known
                && case.hands_in_nothing(index)
                && size(numbers) <= NOTHING * case.rooms[index].by;
            let allowed = if vanishes { Room { turn: f64::INFINITY, ..case.rooms[index] } } else { allowed };
            // That something is nothing shows nothing, but of what is left out by whoever has something else right; and a
            // small number where a mistake that is known leads to one as small.
            let tells = match (case.hands_in_nothing(index), case.is_zero(index)) {
                (true, true) => vanishes || shown && faults.last().is_some_and(Fault::leaves_out),
                (true, false) => vanishes || shown && known && case.meets(index, numbers),
                (false, _) => case.tells(index, numbers, allowed),
            };
            let met = || {
                let right = (&so_far[..], &[Verdict::Right][..]);
                case.miss(index, Some(numbers), allowed) <= 1.0
                    && steps::is_the_students(case, right, index, &seen)
            };
            if verdict.is_none() && tells && met() {
                *verdict = Some(Verdict::Consistent);
                caused[index] = faults.len().checked_sub(1);
            }
        }
    }
    let verdicts = verdicts.into_iter().map(|v| v.unwrap_or(Verdict::NotChecked)).collect();
    Judgement { verdicts, faults, caused, drawn }
}

/// Whether what explains an answer closely is what explained an earlier one.
fn is_made_again(fault: &Fault, mistakes: &[Mistake]) -> bool {
    let (Some(before), Some(now)) = (fault.mistakes.first(), mistakes.first()) else { return false };
    let alone = before.also.is_none() && now.also.is_none();
    let close = before.residual <= CLOSE && now.residual <= CLOSE;
    // A point whose velocity has the wrong sense has its acceleration so too.
    let of_one_point = |one: &Phrase| {
        let of =
            |name: &str| name.strip_prefix(['v', 'a']).filter(|of| of.starts_with('(')).map(str::to_owned);
        before.kind == Kind::SenseReversed && of(&before.at).is_some() && of(&before.at) == of(one)
    };
    let same = |one: &Phrase| {
        before.at == *one || of_one_point(one) || is_one_misconception(now.kind, now.how.as_ref())
    };
    alone && close && before.kind == now.kind && before.how == now.how && same(&now.at)
}

/// Whether a mistake that is told so is one and the same wherever it is made: by the same wrong line in both polygons, by one
/// wrong formula of several links.
fn is_one_misconception(kind: Kind, how: Option<&Phrase>) -> bool {
    match kind {
        Kind::NormalNotSquared
        | Kind::DiameterForRadius
        | Kind::CmAsMm
        | Kind::InchAsFoot
        | Kind::MetreMixed
        | Kind::RadAsRpm
        | Kind::RevAsRad
        | Kind::DegAsRad => true,
        Kind::WrongLine | Kind::PerpendicularForParallel | Kind::WrongFormula => how.is_some(),
        Kind::RateFromWrongVector => {
            how == Some(&say!("from the whole acceleration, not its tangential part"))
        }
        _ => false,
    }
}

/// Whether a mistake is said of all that is of a kind.
fn is_of_all(at: &Phrase) -> bool {
    [
        say!("the velocities"),
        say!("the accelerations"),
        say!("every reading"),
        say!("the directions"),
        say!("every line"),
        say!("every normal part"),
        say!("every normal part that is found"),
        say!("every inertia force"),
        say!("every inertia torque"),
        say!("every offset"),
        say!("every weight"),
        say!("the masses"),
    ]
    .contains(at)
}

#[derive(Clone, Copy)]
struct Judge<'j, 's> {
    case: &'j Case<'s>,
    /// What is known of the drawing so far.
    drawn: &'j Change,
    verdicts: &'j [Option<Verdict>],
    /// The answer to be explained.
    first: usize,
    /// What was found before.
    faults: &'j [Fault],
    /// Whether nothing explains an earlier one.
    unexplained: bool,
}

impl Judge<'_, '_> {
    /// The mistakes that explain the answer, ranked, and all that the student is taken to have drawn so far.
    fn explain(&self) -> (Vec<Mistake>, Change) {
        let Some(base) = self.case.drawn(self.drawn, None) else { return (Vec::new(), self.drawn.clone()) };
        let hypotheses = mistakes::all(self.case, &base, self.drawn);
        let open: Vec<usize> = (0..self.verdicts.len()).filter(|&i| self.verdicts[i].is_none()).collect();
        let unknown = self.unknown(&base);
        let price = unknown.as_ref().map_or(UNKNOWN + MOST, |tried| tried.cost);
        let seen = self.case.seen(&base, self.drawn);
        let unmoved = self.case.miss(self.first, seen[self.first].as_deref(), self.case.rooms[self.first]);
        let standing = self.standing(&seen);
        let explained_by = |hypotheses: &[Hypothesis]| {
            let mut tried = self.tried(&base, hypotheses, self.drawn);
            // What leaves the answer where it was does not explain it.
            tried.retain(|t| unmoved - t.moved >= MOVES);
            let mut tried = self.weighed(tried);
            self.credit(&mut tried);
            tried.retain(|t| {
                t.cost < price
                    && !self.contradicts(t)
                    && !self.is_disproved(t)
                    && !self.harms(t, &standing)
                    && self.has_a_witness(t, &base)
                    && !self.comes_too_late(t)
            });
            tried
        };
        let mut tried = explained_by(&hypotheses);
        let begins = !self.verdicts.contains(&Some(Verdict::Wrong));
        if begins && open.iter().filter(|&&index| !self.case.hands_in_nothing(index)).count() >= CARRIED {
            let misread = explained_by(&misread::all(self.case)).into_iter();
            tried.extend(misread.filter(|one| self.leads_to_all(one)));
            tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        }
        // A number that is found explains more than one that is usual: it is sought where none of these explains all that
        // is open, or one answer. Where the student's own value alone leads to all the others, these tell nothing of it.
        let alone = unknown.as_ref().filter(|own| self.accounts_for_the_others(own));
        if tried.first().is_none_or(|best| begins && !self.leads_to_all(best)) {
            let data = alone.map(|_| self.numbers_amiss(&seen));
            tried.extend(explained_by(&fitted::laid_off(self.case, self.drawn, (&open, data))));
            tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        }
        // A small slip lies near what one of many mistakes leads to; what misses its room by less than another one says nothing
        // by itself.
        let slip = begins && alone.is_some() && self.is_slight(&seen);
        if slip {
            tried.retain(|one| !self.is_by_chance(one));
        }
        let hardly = begins && unmoved <= HARDLY_MISSED;
        if hardly {
            let says_nothing = |one: &Tried| {
                let Mistake { explains, residual, .. } = self.mistake(one);
                // About 1 the inverse of a number is near it.
                let is_near_any =
                    is_one_of_many(&one.hypothesis) || one.hypothesis.kind == Kind::RatioInverted;
                is_near_any && explains < 2 && residual > CALCULATED
            };
            tried.retain(|one| !says_nothing(one));
        }
        let slip = slip || hardly;
        if tried.is_empty() && !slip {
            tried = self.after_own_values(&base, &standing);
        }
        // Two mistakes fit any one number: there must be more to be explained, and nothing before that nobody knows.
        let mut two = false;
        // Nor does any one number that is nothing.
        let plain = !self.unexplained && !self.case.hands_in_nothing(self.first);
        if tried.is_empty() && open.len() > 1 && plain && !slip {
            tried = self.pairs(&base, &hypotheses, price, unmoved);
            two = tried.len() > 1;
        }
        if !two {
            self.commoner_first(&mut tried);
        }
        let Some(best) = tried.first() else {
            return (Vec::new(), unknown.map_or_else(|| self.drawn.clone(), |tried| tried.change));
        };
        let change = best.change.clone();
        let mut mistakes: Vec<Mistake> = Vec::new();
        for tried in &tried {
            let mistake = self.mistake(tried);
            let known = mistakes.iter().any(|m| m.kind == mistake.kind && m.at == mistake.at);
            if !known && mistakes.len() < NAMED {
                mistakes.push(mistake);
            }
        }
        if let (true, [one, other, ..]) = (two, &mut mistakes[..]) {
            one.also = Some(Box::new(other.clone()));
        }
        (mistakes, change)
    }

    /// Whether going on from the student's own value leads to every other open answer.
    fn accounts_for_the_others(&self, own: &Tried) -> bool {
        let others = (0..self.verdicts.len()).filter(|&i| i != self.first && self.verdicts[i].is_none());
        others.into_iter().all(|i| own.misses[i] <= EXPLAINED)
    }

    /// How many numbers of this answer are amiss: its magnitude, its direction.
    fn numbers_amiss(&self, seen: &[Option<Vec<f64>>]) -> usize {
        let room = self.case.rooms[self.first];
        let [off, turned] = self.case.misses(self.first, seen[self.first].as_deref());
        usize::from(off > room.by) + usize::from(turned > room.turn)
    }

    /// Whether the answer is off by no more than a careless hand may slip.
    fn is_slight(&self, seen: &[Option<Vec<f64>>]) -> bool {
        let Some(right) = seen[self.first].as_deref() else { return false };
        let [off, turned] = self.case.misses(self.first, Some(right));
        off <= SLIP.0 * size(right) && turned <= SLIP.1.to_radians()
    }

    /// Whether a mistake that leads near a slight slip is one of so many that one does by chance.
    fn is_by_chance(&self, tried: &Tried) -> bool {
        let of_many = tried.hypothesis.how.is_some() || is_one_of_many(&tried.hypothesis);
        let met = if of_many { MET_BY_ONE_OF_MANY } else { MET };
        self.mistake(tried).residual > met
    }

    /// A vector on its own line in the same polygon from which this answer follows, which does not follow from it and to which
    /// `change`, the best explanation of this answer, does not lead: the fault is there.
    fn cause(&self, change: &Change) -> Option<usize> {
        let sketch = self.case.drawn(change, None)?;
        let seen = self.case.seen(&sketch, change);
        let base = self.case.drawn(self.drawn, None)?;
        let follows = |of: usize, from: usize| {
            let mut verdicts = self.verdicts.to_vec();
            verdicts[from] = Some(Verdict::Wrong);
            let allowed = (self.case.rooms[of].times(EXPLAINED), By::AllTogether);
            routes::follows(self.case, (self.drawn, &base), &verdicts, of, allowed)
        };
        let (order, step, _) = self.case.observations[self.first].rank;
        let beside = |&other: &usize| {
            let (of, at, _) = self.case.observations[other].rank;
            let left = self.case.miss(other, seen[other].as_deref(), self.case.rooms[other]) > EXPLAINED;
            let open = self.verdicts[other].is_none() && !self.case.hands_in_nothing(other);
            other != self.first
                && of == order
                && at != usize::MAX
                && open
                && left
                && self.lies_on_its_line(other)
        };
        let mut others = (0..self.verdicts.len()).filter(beside).filter(|_| step != usize::MAX);
        others.find(|&other| follows(self.first, other) && !follows(other, self.first))
    }

    /// Whether a vector is wrong in its length or its sense alone: it was read on its own line.
    fn lies_on_its_line(&self, index: usize) -> bool {
        let [_, turn] = self.case.misses(index, self.case.truth[index].as_deref());
        let back = std::f64::consts::PI - turn;
        let vector = self.case.observations[index].quantity.as_ref().is_some_and(super::answers::is_vector);
        vector && turn.min(back) <= self.case.rooms[index].turn
    }

    /// One mistake that was made with the student's own earlier values, where none explains the answer by those that belong
    /// to what is known of the drawing.
    fn after_own_values(&self, base: &Sketch, standing: &[(usize, Room)]) -> Vec<Tried> {
        let seen = self.case.seen(base, self.drawn);
        let wrong = (0..self.first).filter(|&index| {
            self.verdicts[index] == Some(Verdict::Wrong) && !self.case.hands_in_nothing(index)
        });
        let mut all = Vec::new();
        for index in wrong.take(OWN) {
            let own = own_values(self.case, base, &self.case.observations[index], seen[index].as_deref());
            for way in own.into_iter().filter(Change::redraws).take(OWN) {
                let drawn = self.drawn.and(&way);
                let Some(sketch) = self.case.drawn(&drawn, None) else { continue };
                let unmoved = self.case.seen_at(self.first, &sketch, &drawn);
                let unmoved = self.case.miss(self.first, unmoved.as_deref(), self.case.rooms[self.first]);
                let hypotheses = mistakes::all(self.case, &sketch, &drawn);
                let mut tried = self.weighed(self.tried(&sketch, &hypotheses, &drawn));
                tried.retain(|one| {
                    unmoved - one.moved >= MOVES
                        && self.mistake(one).residual <= CLOSE
                        && !self.contradicts(one)
                        && !self.harms(one, standing)
                        && !self.comes_too_late(one)
                });
                all.extend(tried);
            }
        }
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all
    }

    /// What one of the closest explanations leaves open may follow from what it explains by another way: that is counted
    /// for it, before one that comes near more answers and meets none.
    fn credit(&self, tried: &mut [Tried]) {
        // Nothing is nearer to all that is open than what meets all of it.
        let meets_all = |best: &Tried| {
            let open = (0..self.verdicts.len()).filter(|&i| self.verdicts[i].is_none());
            open.into_iter().all(|i| best.misses[i] <= EXPLAINED) && self.mistake(best).residual <= MEETS_ALL
        };
        if tried.first().is_none_or(|best| self.mistake(best).residual <= CLOSE || meets_all(best)) {
            return;
        }
        let close = tried.iter_mut().filter(|one| self.mistake(one).residual <= CLOSE);
        for one in close.take(CREDITED) {
            let Some(sketch) = self.case.drawn(&one.change, None) else { continue };
            let mut verdicts = self.verdicts.to_vec();
            let open: Vec<usize> = (0..verdicts.len()).filter(|&i| self.verdicts[i].is_none()).collect();
            for &index in open.iter().filter(|&&i| one.misses[i] <= EXPLAINED) {
                verdicts[index] = Some(Verdict::Consistent);
            }
            verdicts[self.first] = Some(Verdict::Wrong);
            for &index in open.iter().filter(|&&i| one.misses[i] > EXPLAINED) {
                let allowed = self.case.rooms[index].times(EXPLAINED);
                let allowed = (allowed, By::Any);
                if routes::follows(self.case, (&one.change, &sketch), &verdicts, index, allowed) {
                    verdicts[index] = Some(Verdict::Consistent);
                    one.cost += FOLLOWING - square(one.misses[index]).min(MOST);
                }
            }
        }
        tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    }

    /// Of explanations between which the answers do not decide, that which is made most often, before all others.
    fn commoner_first(&self, tried: &mut [Tried]) {
        let Some(best) = tried.first() else { return };
        let (cost, Mistake { explains, residual, .. }) = (best.cost, self.mistake(best));
        let name = &self.case.observations[self.first].name;
        // What was done once is done again.
        let known = |one: &Tried| {
            let mistake = [self.mistake(one)];
            self.faults.iter().any(|fault| is_made_again(fault, &mistake))
        };
        let rarity =
            |one: &Tried| if known(one) { f64::NEG_INFINITY } else { price_of(&one.hypothesis, name) };
        let undecided = |one: &Tried| {
            let mistake = self.mistake(one);
            one.cost <= cost + UNDECIDED
                && mistake.explains >= explains
                && mistake.residual <= CLOSE.min(residual + AS_CLOSE)
        };
        let mut chosen = 0;
        // One of many lengths, lines or links comes a hair nearer than what has no choice, and meets all answers as well.
        let of_many = |one: &Tried| is_one_of_many(&one.hypothesis);
        let without_choice = |one: &Tried| {
            let mistake = self.mistake(one);
            of_many(best)
                && !of_many(one)
                && one.cost <= cost + CHOICE
                && mistake.explains >= explains
                && mistake.residual <= MEETS_ALL
        };
        for (place, one) in tried.iter().enumerate().skip(1) {
            let chosen_by = rarity(one) < rarity(&tried[chosen]) || of_many(&tried[chosen]) && !of_many(one);
            if (undecided(one) || without_choice(one)) && chosen_by {
                chosen = place;
            }
        }
        tried[..=chosen].rotate_right(1);
    }

    /// Whether what is said of a whole diagram, of all parts of a kind or of a factor that was found by fitting is at odds with
    /// an answer that is right.
    fn contradicts(&self, tried: &Tried) -> bool {
        let at = &tried.hypothesis.at;
        // What is calculated from readings may have been found by another way; by a wrong scale only what is read is harmed.
        let scaled = tried.hypothesis.kind.is_of_scale();
        let orders: &[Order] = match () {
            () if scaled && *at == say!("the velocities") => &[Order::Velocity],
            () if scaled && *at == say!("the accelerations") => &[Order::Acceleration],
            () if scaled && *at == say!("every reading") => &[Order::Velocity, Order::Acceleration],
            () => &[],
        };
        // No scale was used of what is measured on paper, but that at which it was drawn.
        let drawn_otherwise = |order: Order| {
            let enlarged = |reading: &Misreading| matches!(reading, Misreading::Enlarged { order: of, .. } if *of == order);
            tried.change.readings.iter().any(enlarged)
        };
        let is_read = |i: usize, order: Order| {
            let observation = &self.case.observations[i];
            let read = |quantity: &Quantity| self.case.includes(Which::Read(order), quantity);
            matches!(observation.target, Target::Asked(_))
                && (!observation.on_paper || drawn_otherwise(order))
                && observation.quantity.as_ref().is_some_and(read)
        };
        let harmed = |i: usize| {
            let speaks = orders.is_empty() || orders.iter().any(|order| is_read(i, *order));
            speaks && self.verdicts[i] == Some(Verdict::Right) && tried.misses[i] > EXPLAINED
        };
        let whole = matches!(
            tried.hypothesis.kind,
            Kind::ScaleWrong | Kind::NormalAwayFromCentre | Kind::NormalNotSquared | Kind::FigureTurned
        );
        // A diagram whose answers are right, and stay so, is not read by another scale.
        let spared = |order: Order| {
            (0..tried.misses.len()).any(|i| {
                let right = self.verdicts[i] == Some(Verdict::Right) && !self.case.is_zero(i);
                is_read(i, order) && right && tried.misses[i] <= EXPLAINED
            })
        };
        let spares = *at == say!("the velocities") && spared(Order::Velocity)
            || *at == say!("the accelerations") && spared(Order::Acceleration);
        spares || (whole || is_of_all(at)) && (0..tried.misses.len()).any(harmed)
    }

    /// Whether an answer that is right was drawn without the mistake, which would have moved it.
    fn is_disproved(&self, tried: &Tried) -> bool {
        // A scale or a unit is taken wrongly where one calculates, and rightly where one draws.
        if tried.hypothesis.kind.enlarges() || !tried.hypothesis.change.redraws() {
            return false;
        }
        let Some(sketch) = self.case.drawn(&tried.change, None) else { return false };
        let right =
            |index: &usize| self.verdicts[*index] == Some(Verdict::Right) && !self.case.is_zero(*index);
        (0..self.verdicts.len()).filter(right).any(|index| {
            let numbers = self.case.seen_at(index, &sketch, &tried.change);
            // By the room of what is right: where a drawing is worse than that, it shows all the more.
            self.case.miss(index, numbers.as_deref(), self.case.rooms[index]) > MOVED
        })
    }

    /// The answers that follow from what is known of the drawing as it is (`seen`), each with its room there.
    fn standing(&self, seen: &[Option<Vec<f64>>]) -> Vec<(usize, Room)> {
        if !self.verdicts.contains(&Some(Verdict::Consistent)) {
            return Vec::new();
        }
        let rooms = self.case.rooms_of(self.drawn, seen, FEW);
        let stands = |index: usize| {
            let follows = self.verdicts[index] == Some(Verdict::Consistent);
            let numbers = seen[index].as_deref().filter(|_| follows)?;
            let usual = self.case.rooms[index].of_size(size(numbers), self.case.right_size(index));
            let room = rooms[index].or(usual).times(EXPLAINED);
            (self.case.miss(index, Some(numbers), room) <= 1.0).then_some((index, room))
        };
        (0..seen.len()).filter_map(stands).collect()
    }

    /// Whether a further mistake would move an answer that follows without it: it was not made before that. What is left out
    /// of a polygon may have been calculated.
    fn harms(&self, tried: &Tried, standing: &[(usize, Room)]) -> bool {
        if standing.is_empty() {
            return false;
        }
        let Some(sketch) = self.case.drawn(&tried.change, None) else { return false };
        let Hypothesis { kind, at, .. } = &tried.hypothesis;
        let moved = |&(index, room): &(usize, Room)| {
            let calculated = kind.leaves_out() && *at == self.case.observations[index].name;
            let numbers = self.case.seen_at(index, &sketch, &tried.change);
            !calculated && self.case.miss(index, numbers.as_deref(), room) > 1.0
        };
        standing.iter().any(moved)
    }

    /// Whether the skeleton is said to be laid off otherwise where nothing explains an earlier answer: it would have shown there.
    fn comes_too_late(&self, tried: &Tried) -> bool {
        self.unexplained && tried.hypothesis.change.relays()
    }

    /// Whether more than one vector speaks for a scale factor that was found by fitting: another one that was read, or what
    /// is calculated from all of them, to which no way of going on from the one alone leads.
    fn has_a_witness(&self, tried: &Tried, base: &Sketch) -> bool {
        // Nor does the leaning of one force alone tell another coefficient of friction.
        let coefficient = tried.hypothesis.kind == Kind::FrictionMisread && tried.hypothesis.how.is_some();
        if coefficient && self.mistake(tried).explains < 2 {
            return false;
        }
        // Nor one direction a calculator in radians: one of its ways to spoil an angle leads near any.
        let directions =
            tried.hypothesis.kind == Kind::CalculatorInRadians && !tried.hypothesis.change.redraws();
        if directions && self.directions_explained(tried) < 2 {
            return false;
        }
        !self.rests_on_one_vector(&tried.hypothesis)
            || self.unknown_by(base, false).is_none_or(|own| tried.cost + UNKNOWN < own.cost)
    }

    /// How many directions that are not right an explanation meets.
    fn directions_explained(&self, tried: &Tried) -> usize {
        let turned = |index: usize| {
            let [_, turn] = self.case.misses(index, self.case.truth[index].as_deref());
            self.case.is_vector(index) && turn > self.case.rooms[index].turn
        };
        let met = |index: &usize| tried.misses[*index] <= EXPLAINED && self.verdicts[*index].is_none();
        (0..tried.misses.len()).filter(met).filter(|&index| turned(index)).count()
    }

    /// Whether a mistake is a scale factor that was found by fitting it to a single vector.
    fn rests_on_one_vector(&self, hypothesis: &Hypothesis) -> bool {
        let fitted = hypothesis.change.readings.iter().find_map(|reading| match *reading {
            Misreading::OtherScale { of: Which::Measured(order), .. } => Some(order),
            _ => None,
        });
        let Some(order) = fitted.filter(|_| hypothesis.kind == Kind::ScaleWrong) else { return false };
        let all = 0..self.case.observations.len();
        all.filter(|&index| self.case.lengthened(index, order).is_some()).count() < 2
    }

    /// Whether a mistake leads closely to what it explains, and leaves hardly anything of what is open.
    fn leads_to_all(&self, tried: &Tried) -> bool {
        let open: Vec<f64> = (0..tried.misses.len())
            .filter(|&i| self.verdicts[i].is_none())
            .map(|i| tried.misses[i])
            .collect();
        let explained = open.iter().filter(|miss| **miss <= EXPLAINED).count();
        10 * explained >= 9 * open.len() && self.mistake(tried).residual <= CLOSE
    }

    fn mistake(&self, tried: &Tried) -> Mistake {
        let Hypothesis { kind, at, step, how, .. } = &tried.hypothesis;
        let explained: Vec<f64> = (0..tried.misses.len())
            .filter(|&i| self.verdicts[i].is_none() && tried.misses[i] <= EXPLAINED)
            .map(|i| tried.misses[i])
            .collect();
        #[expect(clippy::cast_precision_loss, reason = "answers are few")]
        let count = explained.len().max(1) as f64;
        let residual = (explained.iter().map(|m| m * m).sum::<f64>() / count).sqrt();
        Mistake {
            kind: *kind,
            at: at.clone(),
            step: step.map(|s| s + 1),
            how: how.clone(),
            residual,
            explains: explained.len(),
            also: None,
        }
    }

    /// Every hypothesis that explains the first answer, with tolerances taken from the right drawing; the best
    /// first.
    fn tried(&self, base: &Sketch, hypotheses: &[Hypothesis], before: &Change) -> Vec<Tried> {
        let mut tried: Vec<Tried> = Vec::new();
        let before_it = self.case.seen(base, before);
        let nothing = self.case.hands_in_nothing(self.first);
        let collapsed = self.case.is_one_place(self.first);
        for hypothesis in hypotheses {
            let change = before.and(&hypothesis.change);
            let sketch = if hypothesis.change.redraws() { self.case.drawn(&change, None) } else { None };
            if hypothesis.change.redraws() && sketch.is_none() {
                continue;
            }
            let seen = self.case.seen(sketch.as_ref().unwrap_or(base), &change);
            let rooms: Vec<Room> = (0..seen.len())
                .map(|i| {
                    let room = self.case.rooms[i];
                    Room { by: room.by * self.case.times_larger(i, seen[i].as_deref()), ..room }
                })
                .collect();
            // What is nothing for the hand is explained by what is left out, and by no factor; by another line only together
            // with what is something.
            let tells = seen[self.first].as_deref().is_none_or(|numbers| {
                hypothesis.kind.leaves_out()
                    || match nothing {
                        true => self.case.meets(self.first, numbers),
                        false => self.case.tells(self.first, numbers, rooms[self.first]),
                    }
            });
            // What is left out leaves nothing, not little, wide as the room about nothing may be.
            let left = seen[self.first].as_deref().map_or(0.0, size);
            let little = !nothing && 2.0 * left < self.case.given_size(self.first);
            let tells = tells && !(little && hypothesis.kind.leaves_out());
            let room = rooms[self.first].by;
            let vanishes =
                nothing && seen[self.first].as_deref().is_some_and(|numbers| size(numbers) <= room);
            let tried_one = self.counted(hypothesis.clone(), change, &seen, &rooms);
            let tells = tells
                || vanishes
                    && hypothesis.kind == Kind::WrongLine
                    && self.shows_elsewhere(&tried_one, &before_it);
            let tells = tells && !(collapsed && hypothesis.kind.enlarges());
            if tells
                && tried_one.misses[self.first] <= 2.0 * EXPLAINED
                && !self.acquitted(&tried_one, &before_it)
            {
                tried.push(tried_one);
            }
        }
        tried.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        tried
    }

    /// Whether a mistake leads to another open answer that is something, and to which the drawing `before` it does not.
    fn shows_elsewhere(&self, tried: &Tried, before: &[Option<Vec<f64>>]) -> bool {
        (0..tried.misses.len()).any(|index| {
            let was = || self.case.miss(index, before[index].as_deref(), self.case.rooms[index]);
            index != self.first
                && self.verdicts[index].is_none()
                && !self.case.hands_in_nothing(index)
                && tried.misses[index] <= EXPLAINED
                && was() > EXPLAINED
        })
    }

    /// The best of them again, with tolerances of their own.
    fn weighed(&self, tried: Vec<Tried>) -> Vec<Tried> {
        let mut weighed: Vec<Tried> = Vec::new();
        for one in tried.into_iter().take(WEIGHED) {
            let Some(sketch) = self.case.drawn(&one.change, None) else { continue };
            let seen = self.case.seen(&sketch, &one.change);
            let rooms = self.case.rooms_of(&one.change, &seen, FEW);
            // What is as long as the right one is read as well, wherever it points.
            let as_long = |index: usize| {
                let long = seen[index].as_deref().map(size).zip(self.case.right_size(index));
                long.is_some_and(|(long, right)| (long / right - 1.0).abs() <= AS_LONG)
            };
            let wider = |(index, room): (usize, Room)| {
                if as_long(index) { room.or(self.case.rooms[index]) } else { room }
            };
            let rooms: Vec<Room> = rooms.into_iter().enumerate().map(wider).collect();
            let again = self.counted(one.hypothesis, one.change, &seen, &rooms);
            let Hypothesis { kind, how, .. } = &again.hypothesis;
            // The whole acceleration is one vector, not one of many.
            let of_many = one_of_many(*kind)
                && !(*kind == Kind::RateFromWrongVector && is_one_misconception(*kind, how.as_ref()));
            let near = !of_many || self.leads_to_all(&again);
            if again.misses[self.first] <= EXPLAINED && near {
                weighed.push(again);
            }
        }
        weighed.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        weighed
    }

    /// Whether a mistake is said to be made at an answer that is right, or changes the very vector or number that it is, and
    /// leads away from it: `before` is what is seen without it.
    fn acquitted(&self, tried: &Tried, before: &[Option<Vec<f64>>]) -> bool {
        let departs = |quantity: &Quantity| {
            let mut departures = tried.hypothesis.change.departures.iter();
            departures.any(|departure| is_of_forces(departure, quantity))
        };
        let made_at = |observation: &Observation| {
            observation.name == tried.hypothesis.at || observation.quantity.as_ref().is_some_and(departs)
        };
        let all = self.case.observations.iter().enumerate();
        all.filter(|(_, observation)| made_at(observation)).any(|(index, _)| {
            let was = self.case.miss(index, before[index].as_deref(), self.case.rooms[index]);
            self.verdicts[index] == Some(Verdict::Right) && tried.misses[index] - was > MOVES
        })
    }

    /// Counts how badly a hypothesis fits: as the logarithm of how likely the answers are, if it is true.
    fn counted(
        &self,
        hypothesis: Hypothesis,
        change: Change,
        seen: &[Option<Vec<f64>>],
        rooms: &[Room],
    ) -> Tried {
        let mut cost = price_of(&hypothesis, &self.case.observations[self.first].name);
        let moved = self.case.miss(self.first, seen[self.first].as_deref(), self.case.rooms[self.first]);
        let mut misses = Vec::with_capacity(seen.len());
        let mut cost_here = 0.0;
        for (index, numbers) in seen.iter().enumerate() {
            let settled = matches!(self.verdicts[index], Some(Verdict::NotChecked));
            let miss = if settled { 0.0 } else { self.case.miss(index, numbers.as_deref(), rooms[index]) };
            misses.push(miss);
            // Whoever draws better than his tolerance has lost nothing.
            let wider = rooms[index].against(self.case.rooms[index]);
            let counted = square(miss).min(square(miss * wider));
            let counted = if counted.is_finite() { counted.min(MOST) } else { MOST };
            cost += counted;
            // Whoever hands in a number did not leave it out.
            let left_out = hypothesis.kind.leaves_out() && numbers.as_deref().is_some_and(|n| size(n) == 0.0);
            if left_out && hypothesis.at == self.case.observations[index].name && !self.case.is_zero(index) {
                cost += NOT_LEFT_OUT;
            }
            if index == self.first {
                cost_here = counted;
                // Where much more is allowed than of the right drawing, a fit says less.
                let parts =
                    if matches!(self.case.observations[index].given, Given::Vector(_)) { 4.0 } else { 2.0 };
                cost += parts * libm::log(wider / WIDE).clamp(0.0, 1.5);
            }
        }
        Tried { hypothesis, change, cost, here: cost_here, misses, moved }
    }

    /// Two mistakes at once.
    fn pairs(&self, base: &Sketch, hypotheses: &[Hypothesis], price: f64, unmoved: f64) -> Vec<Tried> {
        // A factor that is fitted to one vector leaves nothing of it to be explained by another mistake.
        let collapsed = self.case.is_one_place(self.first);
        let tells = |one: &&Hypothesis| !(self.rests_on_one_vector(one) || collapsed && one.kind.enlarges());
        let hypotheses: Vec<Hypothesis> = hypotheses.iter().filter(tells).cloned().collect();
        let hypotheses = &hypotheses[..];
        // The first of the two is one that explains something by itself, or changes what the answer depends on.
        let mut singles: Vec<Tried> = hypotheses
            .iter()
            .filter_map(|hypothesis| {
                let change = self.drawn.and(&hypothesis.change);
                let sketch =
                    if hypothesis.change.redraws() { Some(self.case.drawn(&change, None)?) } else { None };
                let seen = self.case.seen(sketch.as_ref().unwrap_or(base), &change);
                Some(self.counted(hypothesis.clone(), change, &seen, &self.case.rooms))
            })
            .collect();
        singles.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        // A pair of which one half changes nothing is no pair.
        let alone = self.tried(base, hypotheses, self.drawn);
        let idle = |pair: &Tried| {
            alone
                .iter()
                .any(|one| one.hypothesis.change == pair.hypothesis.change && one.misses == pair.misses)
        };
        let mut all = Vec::new();
        for single in singles.into_iter().take(PAIRED) {
            let Some(sketch) = self.case.drawn(&single.change, None) else { continue };
            for mut pair in self.tried(&sketch, hypotheses, &single.change) {
                let chosen = [single.hypothesis.kind, pair.hypothesis.kind].into_iter().any(one_of_many);
                if chosen && !self.leads_to_all(&pair) {
                    continue;
                }
                pair.cost += SECOND + single.hypothesis.price;
                let leads_to_it = pair.misses[self.first] <= EXPLAINED;
                if leads_to_it && pair.cost < price && !idle(&pair) && unmoved - pair.moved >= MOVES {
                    all.push((single.clone(), pair));
                }
            }
        }
        all.sort_by(|a, b| a.1.cost.total_cmp(&b.1.cost));
        // Both are named, the one that comes first in the solution before the other.
        let Some((single, pair)) = all.into_iter().next() else { return Vec::new() };
        // Of two of which one leaves this answer where it was, only the other explains it; the one is found at the
        // answer that it harms.
        if (single.moved - pair.moved).abs() < MOVES {
            return if single.misses[self.first] <= EXPLAINED { vec![single] } else { Vec::new() };
        }
        if let Some(alone) = alone.into_iter().find(|one| {
            one.hypothesis.change == pair.hypothesis.change
                && (one.moved - pair.moved).abs() < MOVES
                && one.misses[self.first] <= EXPLAINED
        }) {
            return vec![alone];
        }
        let mut pair = pair;
        let mut other = Tried { hypothesis: single.hypothesis, ..pair.clone() };
        if let (Some(one), Some(two)) = (other.hypothesis.step, pair.hypothesis.step)
            && one > two
        {
            std::mem::swap(&mut other.hypothesis, &mut pair.hypothesis);
        }
        if pair.hypothesis.kind == other.hypothesis.kind && pair.hypothesis.at == other.hypothesis.at {
            return Vec::new();
        }
        vec![other, pair]
    }

    /// All that is read off a polygon by the scale by which this answer was read.
    fn by_another_scale(&self, before: Option<&[f64]>) -> Option<Change> {
        let observation = &self.case.observations[self.first];
        let quantity = observation.quantity.filter(|_| matches!(observation.target, Target::Asked(_)))?;
        let order = quantity.order();
        let of = Which::Measured(order);
        let factor = self.case.given_size(self.first) / size(before?);
        let drawn = order != Order::Position && self.case.includes(of, &quantity);
        (drawn && !observation.on_paper && factor.is_finite() && factor > 0.0).then(|| {
            let read = Change::read(Misreading::OtherScale { of, factor });
            read.and(&Change::drawn(vec![Departure::ReadAll { order, factor }]))
        })
    }

    /// The student's own value in the place of the right one, in the way that explains the later answers best.
    fn unknown(&self, base: &Sketch) -> Option<Tried> {
        self.unknown_by(base, true)
    }

    /// The same, with another scale of the whole polygon among the ways or without.
    fn unknown_by(&self, base: &Sketch, scales: bool) -> Option<Tried> {
        let seen = self.case.seen(base, self.drawn);
        let observation = &self.case.observations[self.first];
        let before = seen[self.first].as_deref();
        // Nothing goes on from a value that is nothing.
        let mut ways = match self.case.hands_in_nothing(self.first) {
            true => Vec::new(),
            false => own_values(self.case, base, observation, before),
        };
        ways.extend(self.by_another_scale(before).filter(|_| scales));
        ways.retain(|way| takes_its_place(self.case, &self.drawn.and(way), self.first));
        ways.push(Change::default());
        let mut best: Option<Tried> = None;
        for way in ways {
            let change = self.drawn.and(&way);
            let Some(sketch) = self.case.drawn(&change, None) else { continue };
            let seen = self.case.seen(&sketch, &change);
            let hypothesis = Hypothesis {
                // Never shown: it has no name.
                kind: Kind::SenseReversed,
                at: Phrase::from(""),
                step: None,
                price: UNKNOWN,
                change: way,
                how: None,
            };
            let rooms = self.case.rooms_of(&change, &seen, FEW);
            let mut tried = self.counted(hypothesis, change, &seen, &rooms);
            // The answer itself is what it is.
            tried.cost -= tried.here;
            if best.as_ref().is_none_or(|b| tried.cost < b.cost) {
                best = Some(tried);
            }
        }
        best
    }
}

/// Whether a departure changes just this inertia force, torque or offset.
fn is_of_forces(departure: &Departure, quantity: &Quantity) -> bool {
    let Quantity::Force(force, Share::Total) = *quantity else { return false };
    let (own, of) = match (departure, force) {
        (Departure::InertiaForce { link, .. }, Force::Vector(Action::Inertia(of)))
        | (Departure::InertiaTorque { link, .. }, Force::InertiaTorque(of))
        | (Departure::Offset { link, .. }, Force::Offset(of)) => (*link, of),
        _ => return false,
    };
    own.is_none_or(|own| own == of)
}

/// What a mistake costs by itself at the answer of this name: of two that explain as much, the one that is made at the
/// answer that shows it, or by which something was forgotten, costs less.
fn price_of(hypothesis: &Hypothesis, name: &str) -> f64 {
    let here = if hypothesis.at == *name { AT_HAND } else { 0.0 };
    let forgotten = if hypothesis.kind.leaves_out() { FORGOTTEN } else { 0.0 };
    hypothesis.price - here - forgotten
}

/// The same, or one of many links or lengths.
fn is_one_of_many(hypothesis: &Hypothesis) -> bool {
    let whole = hypothesis.kind == Kind::RateFromWrongVector
        && is_one_misconception(hypothesis.kind, hypothesis.how.as_ref());
    !whole
        && (one_of_many(hypothesis.kind)
            || matches!(hypothesis.kind, Kind::NormalOfWrongLink | Kind::TangentialWrongLength))
}

/// Whether a mistake takes one of many lines, letters, vectors or factors, one of which leads near any value: it must
/// lead to it.
fn one_of_many(kind: Kind) -> bool {
    matches!(
        kind,
        Kind::WrongLine
            | Kind::NeighbourRead
            | Kind::ScaleWrong
            | Kind::CalculatorInRadians
            | Kind::RateFromWrongVector
            | Kind::InputAngle
    )
}

/// Whether a point of a polygon stands where the student has it, in a drawing that was changed so that it should: what is
/// laid off backwards from it moves another one.
pub(super) fn takes_its_place(case: &Case<'_>, changed: &Change, index: usize) -> bool {
    if !matches!(case.observations[index].target, Target::Image(..)) {
        return true;
    }
    let Some(sketch) = case.drawn(changed, None) else { return false };
    let room = case.rooms[index].times(IN_PLACE);
    case.miss(index, case.seen_at(index, &sketch, changed).as_deref(), room) <= 1.0
}

/// A point stands in its place within this part of its room.
const IN_PLACE: f64 = 0.1;

/// How a construction can go on from a student's own value.
pub(super) fn own_values(
    case: &Case<'_>,
    base: &Sketch,
    observation: &Observation,
    before: Option<&[f64]>,
) -> Vec<Change> {
    let mut ways = Vec::new();
    let Some(before) = before else { return ways };
    let length = size(before);
    // The value as numbers; what is not said of sense and direction is as it would be.
    let own: Vec<f64> = match observation.given {
        Given::Magnitude(given) | Given::Drawn(given) if length > 0.0 => {
            before.iter().map(|n| n / length * given).collect()
        }
        Given::Magnitude(_) | Given::Drawn(_) => return ways,
        Given::Signed(given) => vec![given],
        Given::Vector(given) => given.to_vec(),
    };
    let factor = if length > 0.0 { size(&own) / length } else { 1.0 };
    let twist = match (before, &own[..]) {
        ([x, y], [a, b]) if length > 0.0 => Twist { factor, turn: libm::atan2(x * b - y * a, x * a + y * b) },
        _ => Twist::scaled(factor),
    };
    match (observation.target, observation.quantity) {
        (Target::Image(order, label), _) => {
            let si = case.si_per_mm(order);
            match (label, &own[..]) {
                (Label::Image { point, link }, &[x, y]) => {
                    let at = [x / si, y / si];
                    if link.is_some() {
                        ways.extend(moved_foot(base, order, label, at));
                    }
                    let stands = match link.filter(|link| !case.holds(*link, point)) {
                        Some(link) => Departure::Under { order, pin: point, link, at },
                        None => Departure::Image { order, point, at },
                    };
                    ways.push(Change::drawn(vec![stands]));
                }
                (Label::Foot { .. }, &[x, y]) => {
                    ways.extend(moved_foot(base, order, label, [x / si, y / si]))
                }
                _ => {}
            }
        }
        (_, Some(quantity)) => own_quantity(case, base, quantity, &own, (factor, twist), &mut ways),
        _ => {}
    }
    ways
}

/// The vectors that lead to a foot or from it, laid off to where the student has it: one that is subtracted ends where
/// the other begins.
fn moved_foot(base: &Sketch, order: Order, label: Label, at: [f64; 2]) -> Vec<Change> {
    let Some(polygon) = super::case::polygon(&base.construction, order) else { return Vec::new() };
    let laid_off = |vector: &Vector| {
        let old = [vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]];
        let (from, to) = if vector.head == label { (vector.from, at) } else { (at, vector.to) };
        let new = [to[0] - from[0], to[1] - from[1]];
        let length = size(&old);
        let turn = libm::atan2(old[0] * new[1] - old[1] * new[0], old[0] * new[0] + old[1] * new[1]);
        let twist = Twist { factor: size(&new) / length, turn };
        let departure = Departure::LaidOff { quantity: vector.quantity, twist };
        (length > 0.0).then(|| Change::drawn(vec![departure]))
    };
    let touching = polygon.vectors.iter().filter(|v| v.head == label || v.tail == label);
    touching.filter_map(laid_off).collect()
}

/// The first velocity that is calculated, laid off longer or shorter.
fn enlarged_from_the_start(base: &Sketch, factor: f64) -> Option<Change> {
    let acts = base.construction.steps.iter().flat_map(|step| &step.acts);
    let first = acts.filter_map(|act| match *act {
        Act::Calculate(Calculation::Speed { quantity: quantity @ Quantity::Velocity(_), .. }) => {
            Some(Departure::LaidOff { quantity, twist: Twist::scaled(factor) })
        }
        _ => None,
    });
    // Carried on to other links, velocities are calculated too: the first alone is the slip.
    let first: Vec<Departure> = first.take(1).collect();
    (!first.is_empty()).then(|| Change::drawn(first))
}

/// How a balance goes on from a student's own force.
fn own_force(force: Force, own: Option<[f64; 2]>, (factor, twist): (f64, Twist)) -> Option<Change> {
    let departure = match (force, own) {
        (Force::Vector(Action::Inertia(link)), Some(_)) => {
            Departure::InertiaForce { link: Some(link), twist }
        }
        (
            Force::Vector(action @ (Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..))),
            Some(force),
        ) => Departure::ForceIs { action, force },
        (Force::InertiaTorque(link), None) => Departure::InertiaTorque { link: Some(link), factor },
        (Force::Offset(link), None) => Departure::Offset { link: Some(link), factor },
        _ => return None,
    };
    Some(Change::drawn(vec![departure]))
}

fn own_quantity(
    case: &Case<'_>,
    base: &Sketch,
    quantity: Quantity,
    own: &[f64],
    (factor, twist): (f64, Twist),
    ways: &mut Vec<Change>,
) {
    let order = quantity.order();
    let si = case.si_per_mm(order);
    let read = Departure::Read { quantity, factor };
    let vector = match *own {
        [x, y] => Some([x, y]),
        _ => None,
    };
    // A slip in the first vector of the polygon enlarges all of it.
    if let (Order::Velocity, true) = (order, factor.is_finite() && factor != 0.0) {
        ways.extend(enlarged_from_the_start(base, factor));
    }
    match (quantity, vector) {
        (Quantity::Omega(link), None) => {
            let rate = Departure::RateIs { order, link, value: own[0] };
            ways.push(Change::drawn(vec![rate]));
            // A = ω² l, from the student's ω.
            let mut departures = vec![rate];
            for step in &base.construction.steps {
                for act in &step.acts {
                    if let Act::Calculate(Calculation::Normal { quantity, ends, .. }) = *act
                        && ends.iter().all(|p| case.mechanism.link(link).points.contains(p))
                    {
                        let twist = Twist::scaled(factor * factor);
                        departures.push(Departure::LaidOff { quantity, twist });
                    }
                }
            }
            ways.push(Change::drawn(departures));
        }
        (Quantity::Alpha(link), None) => {
            ways.push(Change::drawn(vec![Departure::RateIs { order, link, value: own[0] }]));
        }
        (Quantity::Velocity(point) | Quantity::Acceleration(point), Some([x, y])) => {
            ways.push(Change::drawn(vec![Departure::Image { order, point, at: [x / si, y / si] }]));
            ways.push(Change::drawn(vec![read]));
        }
        (Quantity::RelativeVelocity(b, _) | Quantity::RelativeAcceleration(b, _), Some([x, y])) => {
            ways.push(Change::drawn(vec![read]));
            if let Some(vector) = vector_of(&base.construction, &quantity) {
                let at = [vector.from[0] + x / si, vector.from[1] + y / si];
                ways.push(Change::drawn(vec![Departure::Image { order, point: b, at }]));
            }
        }
        (Quantity::Force(Force::Vector(Action::Load(index)), _), _)
        | (Quantity::Force(Force::LoadTorque(index), _), _)
            if factor > 0.0 =>
        {
            ways.push(Change::of_inputs(InputChange::Load { index, factor }));
        }
        (Quantity::Force(force, Share::Total), vector) => {
            ways.extend(own_force(force, vector, (factor, twist)))
        }
        (_, Some([x, y])) => {
            ways.push(Change::drawn(vec![Departure::LaidOff { quantity, twist }]));
            ways.push(Change::drawn(vec![read]));
            if let Quantity::CoincidentVelocity(pin, link) | Quantity::CoincidentAcceleration(pin, link) =
                quantity
            {
                let at = [x / si, y / si];
                ways.push(Change::drawn(vec![Departure::Under { order, pin, link, at }]));
            }
        }
        _ => {}
    }
    // The value was written down wrongly, and nothing was drawn with it.
    ways.push(Change::read(Misreading::Twisted { of: Which::One(quantity), twist }));
}
