//! Positions: damped Newton iterations group by group, from several starts, until the assembly nearest
//! to the hints is found.
//!
//! Each group of equations ([`super::ordering`]) is solved from the hints and from evenly spread angles;
//! its distinct solutions are the group's assemblies. Places overdetermine: a group with more equations than unknowns
//! has all of them to find its solutions, and there keeps those that say most, so that which equation stands first
//! never makes a dead centre. A group whose solutions no hint tells apart is
//! tried both ways, since a later group or a later hint may decide; if nothing does, the scene is
//! ambiguous. Iteration: Levenberg 1944, Marquardt 1963, finished by Newton's.

use nalgebra::{DMatrix, DVector};

use super::AnalyticError;
use super::constraints::{Motion, Num, Row, Site};
use super::model::{Model, REPEATED};
use super::ordering::{Group, Ordering};
use super::slopes::{Here, Turns};
use super::tape::{Leaf, Linear};
use crate::mechanism::{Place, PointId, Rider};

/// Two solutions closer than this (in mechanism sizes and radians) are one: near a dead centre Newton's
/// iteration cannot separate them, and the Jacobian there is refused.
const SAME: f64 = 1e-7;
/// Hints closer to one solution than to another by less than this part of both distances do not choose.
const UNDECIDED: f64 = 1e-10;
/// Distances to a hint carry rounding of this size (in mechanism sizes).
const UNDECIDED_FLOOR: f64 = 1e-12;
/// A residual this many times its own error is taken as zero.
const AT_ROUNDING: f64 = 64.0;
/// Smallest residual worth improving.
const FLOOR: f64 = 4e-15;
const MOST_ITERATIONS: usize = 80;
/// A start has led to the neighbourhood of a solution where no residual passes this and the last step has not
/// halved it.
const NEAR: f64 = 1e-12;
/// A residual that nothing is left of.
const VANISHED: f64 = 1e-16;
/// A start that ends with a larger residual leads nowhere.
const NEARLY: f64 = 1e-5;
/// By so many rooms of a placed point equations may miss that hang on several of them.
const ROOMS: f64 = 4.0;
/// No more starts are made after so many that led to more than one solution, and to each so many times: a
/// solution to which one start of four leads is missed once in a hundred groups, and the first start is made
/// from the hints.
const ENOUGH_STARTS: usize = 16;
const ENOUGH_TIMES: usize = 5;
/// Every third start is as far from the hints as this, in mechanism sizes, the others to one or two thirds beyond.
const FARTHEST_START: f64 = 1.5;
/// Of a hint that is farther than this from what is known, in mechanism sizes, only the first start is made.
const FARTHEST_HINT: f64 = 2.0;
/// Newton's own steps at the end.
const POLISHINGS: usize = 4;
const MOST_ASSEMBLIES: usize = 64;
/// Groups solved in going back, beyond two rounds of all.
const MOST_GROUPS: usize = 400;
/// An equation of which less than this part says something new gives way to one that says more.
const NEW: f64 = 0.05;
/// Floating-point operations that one group may cost, roughly.
const WORK: f64 = 3e9;

/// The position found.
#[derive(Debug, Clone)]
pub(super) struct Assembly {
    /// Poses of all bodies, scaled.
    pub(super) pose: Vec<f64>,
    /// The order of solution.
    pub(super) ordering: Ordering,
}

#[derive(Debug, Clone)]
struct Solution {
    values: Vec<f64>,
    /// Distances to the hints of the points that it settles.
    miss: Miss,
}

/// How far an assembly lies from its hints. Those of the joints at which a group closes come first; those of its
/// other points count where these have none, or do not choose.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Miss {
    /// From the hints of joints; zero where there are none.
    joints: f64,
    /// From the hints of other points.
    others: f64,
}

impl Miss {
    fn clearly_less(self, other: Self) -> bool {
        clearly_less(self.joints, other.joints)
            || (!clearly_less(other.joints, self.joints) && clearly_less(self.others, other.others))
    }
}

/// A rough place of a point.
#[derive(Debug, Clone)]
struct Hint {
    site: Site,
    near: [f64; 2],
    /// The point is a joint at which its group closes.
    closes: bool,
}

/// Residuals and Jacobian of a group at some place, of all its equations.
struct Glance {
    residuals: DVector<f64>,
    jacobian: DMatrix<f64>,
}

impl Glance {
    fn new(equations: usize, unknowns: usize) -> Self {
        Self { residuals: DVector::zeros(equations), jacobian: DMatrix::zeros(equations, unknowns) }
    }
}

struct Choice {
    group: usize,
    rest: Vec<Solution>,
    decided: bool,
}

struct Assembler<'a> {
    model: &'a Model,
    groups: &'a [Group],
    /// By group: equations beyond its own that depend on nothing later.
    beyond: Vec<Vec<usize>>,
    /// The group with which each body is complete.
    ready: Vec<usize>,
    /// Points with a rough place, by the group that settles them.
    settled: Vec<Vec<Hint>>,
    /// The points of each body, in their own order, with their places in it.
    points_of: Vec<Vec<(PointId, Site)>>,
    /// The swivelling guides that each group completes, by index.
    swivels_of: Vec<Vec<usize>>,
    slot: Vec<usize>,
    /// What an equation may miss by.
    coarsest: f64,
    /// By so much more than usual equations that repeat what is given may miss.
    patience: f64,
    /// How the bodies stood when they were last glanced at.
    turns: Turns,
}

/// Finds the assembly nearest to the hints.
///
/// No equation of it misses by more than `coarsest`, or than rounding where that is more; what repeats given places may miss
/// by what these leave open, and by `patience` times that where a long lever magnifies it.
pub(super) fn assemble(model: &Model, coarsest: f64, patience: f64) -> Result<Assembly, AnalyticError> {
    let pattern = model.pattern_of_position()?;
    let rows = model.position.len();
    let found = assemble_by(model, (&pattern, (0..rows).collect()), coarsest, patience);
    let ambiguous = matches!(found, Err(AnalyticError::Ambiguous { .. }));
    if !(ambiguous || matches!(found, Err(AnalyticError::CannotAssemble { .. })))
        || model.order_of_position(&pattern, &(0..rows).collect::<Vec<_>>()).spare.is_empty()
    {
        return found;
    }
    // Where places say more than is needed, which equations are kept is told by their form; those may say nothing where the
    // mechanism stands, as the x of a pin at the end of a level link: within the rooms of the places it may be met nowhere,
    // or twice. Then others are kept.
    other_sequences(model)
        .into_iter()
        .map(|sequence| assemble_by(model, (&pattern, sequence), coarsest, patience))
        .find(|other| match other {
            Ok(_) => true,
            Err(AnalyticError::Ambiguous { .. }) => !ambiguous,
            Err(_) => false,
        })
        .unwrap_or(found)
}

/// Other sequences in which equations may be kept, where there are more than are needed.
fn other_sequences(model: &Model) -> [Vec<usize>; 2] {
    let rows = model.position.len();
    let mut by_axis: Vec<usize> = (0..rows).collect();
    by_axis.sort_by_key(|row| match model.position[*row] {
        Row::Coincide(_, _, axis) => 2 - 2 * axis.min(1),
        _ => 1,
    });
    [(0..rows).rev().collect(), by_axis]
}

/// The same assembly by other equations, where there are more than are needed: of two guides on one line, with the links
/// that carry them standing by their places, the second one says no more of what rides in both.
pub(super) fn by_other_equations(model: &Model, found: &Assembly, coarsest: f64) -> Vec<Assembly> {
    if found.ordering.spare.is_empty() {
        return Vec::new();
    }
    let Ok(pattern) = model.pattern_of_position() else { return Vec::new() };
    let apart = |column: usize, by: f64| if column % 3 == 2 { wrapped(by) } else { by };
    let is_same = |other: &Assembly| {
        let pairs = other.pose.iter().zip(&found.pose).enumerate();
        pairs.into_iter().all(|(column, (one, other))| apart(column, one - other).abs() <= SAME)
    };
    let others = other_sequences(model).into_iter();
    let assembled =
        others.filter_map(|sequence| assemble_by(model, (&pattern, sequence), coarsest, 1.0).ok());
    assembled.filter(is_same).collect()
}

/// The same, with equations kept in this sequence.
fn assemble_by(
    model: &Model,
    (pattern, sequence): (&[Vec<usize>], Vec<usize>),
    coarsest: f64,
    patience: f64,
) -> Result<Assembly, AnalyticError> {
    let ordering = model.order_of_position(pattern, &sequence);
    let free: Vec<usize> =
        ordering.free.iter().map(|c| c / 3).filter(|b| *b != 0 && model.kept[*b]).collect();
    if !free.is_empty() {
        return Err(AnalyticError::Underdetermined { links: numbers(model, &free) });
    }
    let mut assembler = Assembler::new(model, &ordering, pattern, coarsest);
    assembler.patience = patience;
    let pose = assembler.search(&ordering)?;
    let chosen: Vec<Vec<usize>> = (0..ordering.groups.len()).map(|at| assembler.choose(at, &pose)).collect();
    let mut ordering = ordering;
    for (group, rows) in ordering.groups.iter_mut().zip(chosen) {
        group.rows = rows;
    }
    Ok(Assembly { pose, ordering })
}

/// Link numbers of bodies, ascending, each once.
pub(super) fn numbers(model: &Model, bodies: &[usize]) -> Vec<u32> {
    let mut numbers: Vec<u32> =
        bodies.iter().filter_map(|b| model.mechanism.links.get(*b)).map(|l| l.number).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

fn wrapped(angle: f64) -> f64 {
    angle - (angle / std::f64::consts::TAU).round() * std::f64::consts::TAU
}

/// Whether one distance to the hints is so much less than another that it chooses.
fn clearly_less(one: f64, other: f64) -> bool {
    other - one > UNDECIDED * (one + other) + UNDECIDED_FLOOR
}

/// The tolerance of an equation: its rounding and what its parameters leave open.
pub(super) fn tolerance(model: &Model, linear: &Linear) -> f64 {
    let open: f64 = linear
        .terms
        .iter()
        .map(|(leaf, c)| match leaf {
            Leaf::Param(at) => c.abs() * model.params[*at].error,
            _ => 0.0,
        })
        .sum();
    AT_ROUNDING * (linear.rounding + open) + FLOOR
}

impl<'a> Assembler<'a> {
    fn new(model: &'a Model, ordering: &'a Ordering, pattern: &[Vec<usize>], coarsest: f64) -> Self {
        let groups = &ordering.groups;
        let mut ready = vec![0; model.bodies];
        let mut slot = vec![usize::MAX; model.unknowns()];
        let mut group_of = vec![None; model.unknowns()];
        for (index, group) in groups.iter().enumerate() {
            let known = model.is_known(group);
            for (local, column) in group.columns.iter().enumerate() {
                if !known {
                    ready[column / 3] = ready[column / 3].max(index);
                }
                slot[*column] = local;
                group_of[*column] = Some(index);
            }
        }
        let mut beyond = vec![Vec::new(); groups.len()];
        for row in &ordering.spare {
            let last = pattern[*row].iter().filter_map(|column| group_of[*column]).max();
            if let Some(group) = last {
                beyond[group].push(*row);
            }
        }
        // The group with which the first kept guide of each pin is complete.
        let mut ridden = vec![usize::MAX; model.mechanism.points.len()];
        for slide in &model.mechanism.slides {
            if let Rider::Pin { point, .. } = slide.rider
                && model.kept[slide.guide.link.0]
            {
                ridden[point.0] = ridden[point.0].min(ready[slide.guide.link.0]);
            }
        }
        let mut points_of = vec![Vec::new(); model.bodies];
        for (index, sites) in model.sites.iter().enumerate() {
            for site in sites {
                points_of[site.body].push((PointId(index), *site));
            }
        }
        let mut swivels_of = vec![Vec::new(); groups.len()];
        for (index, swivel) in model.swivels.iter().enumerate() {
            let rider = if swivel.rider.body == 0 { 0 } else { ready[swivel.rider.body] };
            if let Some(completed) = swivels_of.get_mut(ready[swivel.body].max(rider)) {
                completed.push(index);
            }
        }
        let mut settled: Vec<Vec<Hint>> = vec![Vec::new(); groups.len()];
        for (index, point) in model.mechanism.points.iter().enumerate() {
            let Place::Near(near) = point.place else { continue };
            let first = model.sites[index].iter().filter(|s| s.body != 0).min_by_key(|s| ready[s.body]);
            if let Some(site) = first {
                let group = ready[site.body];
                let here = model.sites[index].iter().filter(|s| ready[s.body] <= group).count();
                let closes = here > 1 || ridden[index] <= group;
                let hint = Hint { site: *site, near: model.scaled(near), closes };
                settled[group].push(hint);
            }
        }
        let turns = Turns::new(model.bodies);
        let patience = 1.0;
        Self { model, groups, beyond, ready, settled, points_of, swivels_of, slot, coarsest, patience, turns }
    }

    fn value(&self, num: Num) -> f64 {
        match num {
            Num::Exact(value) => value,
            Num::Param(at) => self.model.params[at].value,
        }
    }

    fn world(&self, site: &Site, pose: &[f64]) -> [f64; 2] {
        let own = site.own.map(|c| self.value(c));
        if site.body == 0 {
            return own;
        }
        let (sin, cos) = libm::sincos(pose[3 * site.body + 2]);
        let at = 3 * site.body;
        [pose[at] + cos * own[0] - sin * own[1], pose[at + 1] + sin * own[0] + cos * own[1]]
    }

    fn linear(&self, row: &Row, pose: &[f64]) -> Option<Linear> {
        row.linear(Motion { pose, rate: &[], accel: &[], params: &self.model.params }, 0)
    }

    // --- the search over assemblies ---

    fn search(&self, ordering: &Ordering) -> Result<Vec<f64>, AnalyticError> {
        let mut pose = vec![0.0; self.model.unknowns()];
        let mut choices: Vec<Choice> = Vec::new();
        let mut best: Option<(Miss, Vec<f64>)> = None;
        let mut rival: Option<Vec<f64>> = None;
        let mut failure: Option<(usize, f64)> = None;
        let mut group = 0;
        let mut complete = 0;
        let mut budget = MOST_GROUPS + 2 * self.groups.len();
        loop {
            let mut stuck = None;
            while group < self.groups.len() {
                budget = budget.saturating_sub(1);
                match self.solutions(group, &mut pose) {
                    Err(residual) => {
                        stuck = Some(residual);
                        break;
                    }
                    Ok(mut found) => {
                        found.reverse();
                        let Some(first) = found.pop() else { break };
                        self.take(group, &first, &mut pose);
                        if let Some(next) = found.last() {
                            let decided = first.miss.clearly_less(next.miss);
                            choices.push(Choice { group, rest: found, decided });
                        }
                        group += 1;
                    }
                }
            }
            let residual = stuck.or_else(|| self.repeated_miss(ordering, &pose));
            if let Some(residual) = residual {
                if failure.is_none_or(|f| group > f.0 || (group == f.0 && residual < f.1)) {
                    failure = Some((group, residual));
                }
            } else {
                complete += 1;
                let miss = self.miss(&pose);
                match &best {
                    Some((least, _)) if least.clearly_less(miss) => {}
                    Some((least, _)) if !miss.clearly_less(*least) => rival = Some(pose.clone()),
                    _ => {
                        best = Some((miss, pose.clone()));
                        rival = None;
                    }
                }
                // A draughtsman goes back only on what no hint decided.
                choices.retain(|c| !c.decided);
            }
            let next = loop {
                let Some(choice) = choices.last_mut() else { break None };
                match choice.rest.pop() {
                    Some(solution) => break Some((choice.group, solution)),
                    None => {
                        choices.pop();
                    }
                }
            };
            match next {
                Some((at, solution)) if complete < MOST_ASSEMBLIES && budget > 0 => {
                    self.take(at, &solution, &mut pose);
                    group = at + 1;
                }
                _ => break,
            }
        }
        match (best, rival) {
            (Some((_, pose)), None) => Ok(pose),
            (Some((_, one)), Some(other)) => Err(self.ambiguous(&one, &other)),
            (None, _) => {
                let (group, residual) = failure.unwrap_or((0, 0.0));
                let bodies: Vec<usize> = match self.groups.get(group) {
                    Some(group) => group.columns.iter().map(|c| c / 3).collect(),
                    None => (1..self.model.bodies).collect(),
                };
                Err(AnalyticError::CannotAssemble {
                    links: numbers(self.model, &bodies),
                    residual: residual * self.model.length,
                })
            }
        }
    }

    fn ambiguous(&self, one: &[f64], other: &[f64]) -> AnalyticError {
        let m = &self.model.mechanism;
        let points = (0..m.points.len())
            .filter(|index| {
                self.model.sites[*index].first().is_some_and(|site| {
                    let (a, b) = (self.world(site, one), self.world(site, other));
                    libm::hypot(a[0] - b[0], a[1] - b[1]) > SAME
                })
            })
            .map(|index| m.points[index].name.clone())
            .collect::<Vec<_>>();
        // Parts that are too small to tell their places apart stand otherwise all the same.
        let stands = |body: &usize| (0..3).any(|axis| one[3 * body + axis] != other[3 * body + axis]);
        let links = (1..m.links.len()).filter(stands).map(|body| format!("link {}", m.links[body].number));
        let points = if points.is_empty() { links.collect() } else { points };
        AnalyticError::Ambiguous { points }
    }

    /// Distance of an assembly to all hints.
    fn miss(&self, pose: &[f64]) -> Miss {
        self.miss_of(self.settled.iter().flatten(), pose)
    }

    fn miss_of<'h>(&self, hints: impl Iterator<Item = &'h Hint>, pose: &[f64]) -> Miss {
        let mut squares = [0.0; 2];
        for hint in hints {
            let at = self.world(&hint.site, pose);
            let d = [at[0] - hint.near[0], at[1] - hint.near[1]];
            squares[usize::from(!hint.closes)] += d[0] * d[0] + d[1] * d[1];
        }
        let [joints, others] = squares.map(f64::sqrt);
        Miss { joints, others }
    }

    /// By how much an equation that repeats others may miss, in mechanism sizes: rounding, and what placed points leave open.
    fn repeated(&self) -> f64 {
        let rooms = self.model.mechanism.points.iter().filter_map(|point| match point.place {
            Place::Placed(at) => Some(at[0].error.max(at[1].error)),
            Place::Fixed(_) | Place::Stated(_) | Place::Near(_) | Place::Unknown => None,
        });
        self.patience * (REPEATED + ROOMS * rooms.fold(0.0, f64::max) / self.model.length)
    }

    /// The worst of the equations that should hold by themselves, if it does not.
    fn repeated_miss(&self, ordering: &Ordering, pose: &[f64]) -> Option<f64> {
        let spare = ordering.spare.iter().map(|row| &self.model.position[*row]);
        let worst = self
            .model
            .repeated
            .iter()
            .chain(spare)
            .map(|row| self.linear(row, pose).map_or(f64::INFINITY, |l| l.value.abs()))
            .fold(0.0, f64::max);
        (worst > self.repeated()).then_some(worst)
    }

    fn take(&self, group: usize, solution: &Solution, pose: &mut [f64]) {
        for (column, value) in self.groups[group].columns.iter().zip(&solution.values) {
            pose[*column] = *value;
        }
    }

    // --- one group ---

    /// All solutions of a group, the nearest to its hints first; the least residual where there is none.
    fn solutions(&self, index: usize, pose: &mut [f64]) -> Result<Vec<Solution>, f64> {
        let group = &self.groups[index];
        let angles = group.columns.iter().filter(|c| *c % 3 == 2).count();
        let linear = self.has_one_solution(group);
        let wanted = match (linear, angles) {
            (true, _) => 1,
            (false, 0 | 1) => 16,
            (false, 2) => 40,
            (false, _) => 80,
        };
        let most = self.most(group);
        let n = group.columns.len() as f64;
        let affordable = (WORK / (40.0 * (n * n * n + 300.0 * n))).max(2.0) as usize;

        let mut found: Vec<Solution> = Vec::new();
        // Where the starts have led, and how many to each.
        let mut ends: Vec<(Vec<f64>, usize)> = Vec::new();
        let mut least = f64::INFINITY;
        for start in 0..wanted.min(affordable) {
            if most.is_some_and(|most| ends.len() >= most) {
                break;
            }
            if start >= ENOUGH_STARTS && ends.len() > 1 && ends.iter().all(|end| end.1 >= ENOUGH_TIMES) {
                break;
            }
            self.start(index, start, pose);
            let known = |ends: &[(Vec<f64>, usize)], pose: &[f64]| {
                ends.iter().position(|(values, _)| {
                    group.columns.iter().zip(values).all(|(column, value)| {
                        let d = pose[*column] - value;
                        let d = if column % 3 == 2 { wrapped(d) } else { d };
                        d.abs() < SAME
                    })
                })
            };
            // Newton's step alone solves linear equations, where they can be solved.
            let straight = if linear { self.finish(index, pose, false) } else { Err(f64::INFINITY) };
            if straight.is_err() {
                if let Some(residual) = self.approach(index, pose) {
                    least = least.min(residual);
                    continue;
                }
                if let Some(end) = known(&ends, pose) {
                    ends[end].1 += 1;
                    continue;
                }
            }
            match straight.or_else(|_| self.finish(index, pose, true)) {
                Err(residual) => least = least.min(residual),
                Ok(()) => {
                    if let Some(end) = known(&ends, pose) {
                        ends[end].1 += 1;
                        continue;
                    }
                    let values: Vec<f64> = group.columns.iter().map(|c| pose[*c]).collect();
                    ends.push((values.clone(), 1));
                    if self.faces_riders(index, pose) {
                        let miss = self.miss_of(self.settled[index].iter(), pose);
                        found.push(Solution { values, miss });
                    }
                }
            }
        }
        if found.is_empty() {
            return Err(if least.is_finite() { least } else { 1.0 });
        }
        found.sort_by(|a, b| a.miss.joints.total_cmp(&b.miss.joints));
        // Among those that the joints leave open the other points choose.
        let least = found[0].miss.joints;
        let open = found.iter().take_while(|s| !clearly_less(least, s.miss.joints)).count();
        found[..open].sort_by(|a, b| a.miss.others.total_cmp(&b.miss.others));
        Ok(found)
    }

    /// Whether the equations of a group are linear in its unknowns.
    fn has_one_solution(&self, group: &Group) -> bool {
        let mut rows = group.rows.iter().map(|r| &self.model.position[*r]);
        let angles = group.columns.iter().filter(|c| *c % 3 == 2).count();
        (angles == group.columns.len() && rows.clone().all(Row::is_simple))
            || (angles == 0 && rows.all(Row::is_linear_in_places))
    }

    /// How many solutions a group can have at most, where its equations say so: when so many have been found there is
    /// no other, and no further start is made. Where fewer are found all starts are made.
    ///
    /// - One body turns about a known point, or turns and its place follows by a pin from a known point, and one
    ///   equation of the form a cos θ + b sin θ = c is left for its angle, perhaps through a body that a pin carries
    ///   along without turning: two. (Where a, b and c vanish all angles fit, and the Jacobian tells.)
    /// - Two such bodies share a pin: it lies on two circles, which meet in two points at most, and each of these
    ///   gives both angles.
    ///
    /// Anything else is not counted.
    fn most(&self, group: &Group) -> Option<usize> {
        let of_axis = |axis: usize| {
            group.columns.iter().filter(move |c| *c % 3 == axis).map(|c| c / 3).collect::<Vec<usize>>()
        };
        let [xs, ys, turning] = [0, 1, 2].map(of_axis);
        if xs != ys || !(1..=2).contains(&turning.len()) {
            return None;
        }
        let mut rows: Vec<&Row> = group.rows.iter().map(|r| &self.model.position[*r]).collect();
        for body in &xs {
            let turns = turning.contains(body);
            let carrier = |other: usize| {
                let known = !xs.contains(&other) && !turning.contains(&other);
                if turns { known } else { turning.contains(&other) }
            };
            let pin = rows.iter().find_map(|row| match row {
                Row::Coincide(a, b, _) if a.body == *body && carrier(b.body) => Some([*a, *b]),
                Row::Coincide(a, b, _) if b.body == *body && carrier(a.body) => Some([*a, *b]),
                _ => None,
            });
            let [a, b] = pin?;
            let before = rows.len();
            rows.retain(|row| !matches!(row, Row::Coincide(c, d, _) if *c == a && *d == b));
            if before - rows.len() != 2 {
                return None;
            }
        }
        match (turning.as_slice(), rows.as_slice()) {
            ([_], [row]) if row.is_circular() => Some(2),
            ([one, other], [Row::Coincide(a, b, first), Row::Coincide(c, d, second)]) => {
                let bound = [a.body, b.body];
                let shared = a == c && b == d && first != second;
                (shared && bound.contains(one) && bound.contains(other)).then_some(2)
            }
            _ => None,
        }
    }

    /// Whether the swivelling guides that this group completes point towards their riders.
    fn faces_riders(&self, index: usize, pose: &[f64]) -> bool {
        self.swivels_of[index].iter().all(|swivel| {
            let swivel = &self.model.swivels[*swivel];
            let Some(ray) = swivel.ray else { return true };
            let rider = self.world(&swivel.rider, pose);
            let at = 3 * swivel.body;
            let (sin, cos) = libm::sincos(pose[at + 2] + ray);
            cos * (rider[0] - pose[at]) + sin * (rider[1] - pose[at + 1]) > -FLOOR
        })
    }

    /// The place of a point as far as it is known before this group.
    fn known(&self, point: PointId, group: usize, pose: &[f64]) -> Option<[f64; 2]> {
        if let Some(place) = self.model.places[point.0] {
            return Some(place.map(|c| self.value(c)));
        }
        let solved = self.model.sites[point.0].iter().find(|s| s.body == 0 || self.ready[s.body] < group);
        solved.map(|site| self.world(site, pose))
    }

    /// The place of a point as far as it is known before this group, or hinted.
    fn guess(&self, point: PointId, group: usize, pose: &[f64]) -> Option<[f64; 2]> {
        match (self.known(point, group, pose), self.model.mechanism.points[point.0].place) {
            (Some(at), _) => Some(at),
            (None, Place::Near(near)) => Some(self.model.scaled(near)),
            _ => None,
        }
    }

    /// In the middle of the points of these bodies that are known before a group.
    fn middle(&self, bodies: &[usize], group: usize, pose: &[f64]) -> Option<[f64; 2]> {
        let points = bodies.iter().flat_map(|body| &self.points_of[*body]);
        let known: Vec<[f64; 2]> = points.filter_map(|(point, _)| self.known(*point, group, pose)).collect();
        let mean = |axis: usize| known.iter().map(|at| at[axis]).sum::<f64>() / known.len() as f64;
        (!known.is_empty()).then(|| [mean(0), mean(1)])
    }

    /// Writes the start of this number into the unknowns of a group: the hints first, then angles and
    /// places spread evenly (Weyl sequences of the square roots of primes).
    fn start(&self, index: usize, start: usize, pose: &mut [f64]) {
        let spread = |k: usize| {
            const ROOTS: [f64; 8] = [
                0.414_213_562_373_095,
                0.732_050_807_568_877,
                0.236_067_977_499_79,
                0.645_751_311_064_591,
                0.316_624_790_355_4,
                0.605_551_275_463_989,
                0.123_105_625_617_661,
                0.358_898_943_540_674,
            ];
            let turn = (k / ROOTS.len()) as f64 * 0.377;
            (start as f64 * ROOTS[k % ROOTS.len()] + turn + 0.05).fract()
        };
        let group = &self.groups[index];
        let mut bodies: Vec<usize> = group.columns.iter().map(|c| c / 3).collect();
        bodies.dedup();
        // A hint far off chooses among assemblies; around it there is none to be found.
        let middle = if start == 0 { None } else { self.middle(&bodies, index, pose) };
        let nearer = |at: [f64; 2]| match middle {
            Some(middle) => {
                let away = [0, 1].map(|axis| at[axis] - middle[axis]);
                let part = (FARTHEST_HINT / libm::hypot(away[0], away[1])).min(1.0);
                [0, 1].map(|axis| middle[axis] + part * away[axis])
            }
            None => at,
        };
        let mut k = 0;
        for body in bodies {
            let hints: Vec<([f64; 2], [f64; 2])> = self.points_of[body]
                .iter()
                .filter_map(|(point, site)| {
                    let known = self.known(*point, index, pose);
                    let at = known.or_else(|| self.guess(*point, index, pose).map(nearer))?;
                    Some((site.own.map(|c| self.value(c)), at))
                })
                .collect();
            let mine = |axis: usize| {
                let column = 3 * body + axis;
                group.columns.binary_search(&column).is_ok()
            };
            if mine(2) {
                pose[3 * body + 2] = if start == 0 {
                    direction(&hints).unwrap_or(0.0)
                } else {
                    k += 1;
                    std::f64::consts::TAU * (spread(k - 1) - 0.5)
                };
            }
            let (sin, cos) = libm::sincos(pose[3 * body + 2]);
            // The joint nearest to the origin of the body: its angle may be found later.
            let arm = |hint: &&([f64; 2], [f64; 2])| libm::hypot(hint.0[0], hint.0[1]);
            let nearest = hints.iter().min_by(|a, b| arm(a).total_cmp(&arm(b)));
            for axis in [0, 1].into_iter().filter(|axis| mine(*axis)) {
                let base = nearest.map_or(0.0, |(own, at)| {
                    at[axis]
                        - if axis == 0 { cos * own[0] - sin * own[1] } else { sin * own[0] + cos * own[1] }
                });
                let shift = if start == 0 {
                    0.0
                } else {
                    k += 1;
                    // Near and far by turns.
                    FARTHEST_START * (1 + start % 3) as f64 * (spread(k - 1) - 0.5)
                };
                pose[3 * body + axis] = base + shift;
            }
        }
    }

    /// The equations of a group and those beyond.
    fn all_rows(&self, index: usize) -> impl Iterator<Item = usize> {
        self.groups[index].rows.iter().chain(&self.beyond[index]).copied()
    }

    /// As many equations of a group as it has unknowns: its own, but those that say nothing new here give way to
    /// others that do. In order of the equations that they stand for.
    fn choose(&self, index: usize, pose: &[f64]) -> Vec<usize> {
        let group = &self.groups[index];
        let own = || group.rows.clone();
        if self.beyond[index].is_empty() {
            return own();
        }
        let n = group.columns.len();
        let mut rows: Vec<(usize, DVector<f64>)> = Vec::new();
        for row in self.all_rows(index) {
            let Some(linear) = self.linear(&self.model.position[row], pose) else { return own() };
            let mut slopes = DVector::zeros(n);
            // Beside what it says of bodies that are known: of a guide along x, an angle of half a turn leaves some
            // 1e-16 that depend on y.
            let mut square = 0.0;
            for (leaf, value) in &linear.terms {
                if let Leaf::Pose(column) = leaf {
                    square += value * value;
                    let j = self.slot[*column];
                    if group.columns.get(j) == Some(column) {
                        slopes[j] = *value;
                    }
                }
            }
            if square > 0.0 {
                rows.push((row, slopes / square.sqrt()));
            }
        }
        // Gram and Schmidt: what is left of each row beside those that are taken.
        let mut taken: Vec<(usize, DVector<f64>)> = Vec::new();
        let rest = |slopes: &DVector<f64>, taken: &[(usize, DVector<f64>)]| {
            let mut rest = slopes.clone();
            // Twice, for the rounding of the first time.
            for (_, other) in taken.iter().chain(taken) {
                let along = rest.dot(other);
                rest.axpy(-along, other, 1.0);
            }
            rest
        };
        let mut put_off = Vec::new();
        for (row, slopes) in rows {
            let rest = rest(&slopes, &taken);
            let length = rest.norm();
            if taken.len() < n && length > NEW {
                taken.push((row, rest / length));
            } else {
                put_off.push((row, slopes));
            }
        }
        while taken.len() < n {
            let left = put_off.iter().enumerate().map(|(at, (_, slopes))| (at, rest(slopes, &taken)));
            let Some((at, most)) = left.max_by(|a, b| a.1.norm().total_cmp(&b.1.norm())) else {
                return own();
            };
            let length = most.norm();
            if length == 0.0 {
                return own();
            }
            taken.push((put_off.remove(at).0, most / length));
        }
        let mut chosen: Vec<usize> = taken.into_iter().map(|(row, _)| row).collect();
        chosen.sort_unstable();
        chosen
    }

    /// Iterates on the equations of a group that say most where it stands; the largest residual where they end
    /// elsewhere than at a solution, or where an equation beyond them does not hold.
    fn finish(&self, index: usize, pose: &mut [f64], damped: bool) -> Result<(), f64> {
        let mut rows = self.choose(index, pose);
        self.iterate(index, &rows, pose, damped)?;
        let now = self.choose(index, pose);
        if now != rows {
            rows = now;
            self.iterate(index, &rows, pose, false)?;
        }
        let worst = self
            .all_rows(index)
            .filter(|row| !rows.contains(row))
            .map(|row| self.linear(&self.model.position[row], pose).map_or(f64::INFINITY, |l| l.value.abs()))
            .fold(0.0, f64::max);
        if worst > self.repeated() { Err(worst) } else { Ok(()) }
    }

    /// Residuals and Jacobian of all equations of a group without their errors; `None` where an equation has no value
    /// here or binds more than two bodies.
    fn glance(&self, index: usize, pose: &[f64], at: &mut Glance) -> Option<()> {
        let group = &self.groups[index];
        at.jacobian.fill(0.0);
        for (i, row) in self.all_rows(index).enumerate() {
            let row = &self.model.position[row];
            let slope = Here::evaluate(row, pose, &self.model.params, &self.turns)?;
            at.residuals[i] = slope.value;
            for (column, slope) in slope.columns_and_slopes(row) {
                let j = self.slot[column];
                if group.columns.get(j) == Some(&column) {
                    at.jacobian[(i, j)] = slope;
                }
            }
        }
        Some(())
    }

    /// Damped Newton iterations without a record, from a start to the neighbourhood of a solution; the largest
    /// residual where they end elsewhere.
    fn approach(&self, index: usize, pose: &mut [f64]) -> Option<f64> {
        let group = &self.groups[index];
        let (n, equations) = (group.columns.len(), self.all_rows(index).count());
        let (mut at, mut tried) = (Glance::new(equations, n), Glance::new(equations, n));
        // What cannot be glanced at is left to the record.
        self.glance(index, pose, &mut at)?;
        let mut before = vec![0.0; n];
        let (mut normal, mut step) = (DMatrix::zeros(n, n), DVector::zeros(n));
        let mut damping = 1e-3;
        let mut idle = 0;
        let mut halved = true;
        for _ in 0..MOST_ITERATIONS {
            let rest = at.residuals.amax();
            // Towards a dead centre the residual goes on falling, and with it the distance from the solution.
            if rest <= VANISHED.max(self.coarsest) || (rest <= NEAR && !halved) || idle > 12 {
                break;
            }
            at.jacobian.tr_mul_to(&at.jacobian, &mut normal);
            let largest = normal.diagonal().max();
            for i in 0..n {
                normal[(i, i)] += damping * normal[(i, i)].max(1e-14 * largest);
            }
            at.jacobian.tr_mul_to(&at.residuals, &mut step);
            let better = match std::mem::replace(&mut normal, DMatrix::zeros(0, 0)).cholesky() {
                Some(factors) => {
                    factors.solve_mut(&mut step);
                    normal = factors.unpack_dirty();
                    Self::move_by(group, pose, &step, &mut before);
                    let closer = self.glance(index, pose, &mut tried).is_some()
                        && tried.residuals.norm() < at.residuals.norm();
                    if !closer {
                        Self::move_back(group, pose, &before);
                    }
                    closer
                }
                None => {
                    normal = DMatrix::zeros(n, n);
                    false
                }
            };
            if better {
                halved = tried.residuals.norm() < 0.5 * at.residuals.norm();
                let lazy = tried.residuals.norm() >= 0.999 * at.residuals.norm();
                idle = if lazy { idle + 1 } else { 0 };
                std::mem::swap(&mut at, &mut tried);
                damping = (damping * 0.1_f64).max(1e-15);
            } else {
                halved = false;
                idle += 1;
                damping = (damping * 6.0_f64).max(1e-12);
            }
        }
        let rest = at.residuals.amax();
        (rest > NEARLY.max(self.coarsest).max(self.repeated())).then_some(rest)
    }

    /// Moves the unknowns of a group; `before` keeps where they were.
    fn move_by(group: &Group, pose: &mut [f64], step: &DVector<f64>, before: &mut [f64]) {
        for ((column, d), before) in group.columns.iter().zip(step.iter()).zip(before) {
            *before = pose[*column];
            let moved = pose[*column] - d;
            pose[*column] = if column % 3 == 2 { wrapped(moved) } else { moved };
        }
    }

    fn move_back(group: &Group, pose: &mut [f64], before: &[f64]) {
        for (column, before) in group.columns.iter().zip(before) {
            pose[*column] = *before;
        }
    }

    /// Residuals, tolerances and Jacobian of as many equations of a group as it has unknowns; `None` where one has no
    /// value here.
    fn evaluate(
        &self,
        index: usize,
        rows: &[usize],
        pose: &[f64],
    ) -> Option<(DVector<f64>, Vec<f64>, DMatrix<f64>)> {
        let group = &self.groups[index];
        let n = rows.len();
        let mut residuals = DVector::zeros(n);
        let mut tolerances = vec![0.0; n];
        let mut jacobian = DMatrix::zeros(n, n);
        for (i, row) in rows.iter().enumerate() {
            let linear = self.linear(&self.model.position[*row], pose)?;
            residuals[i] = linear.value;
            tolerances[i] = tolerance(self.model, &linear).max(self.coarsest);
            for (leaf, value) in &linear.terms {
                if let Leaf::Pose(column) = leaf {
                    let j = self.slot[*column];
                    if group.columns.get(j) == Some(column) {
                        jacobian[(i, j)] = *value;
                    }
                }
            }
        }
        Some((residuals, tolerances, jacobian))
    }

    /// Damped Newton iterations on equations of one group, if they are wanted, and then Newton's own; the largest
    /// residual where they end elsewhere than at a solution.
    fn iterate(&self, index: usize, rows: &[usize], pose: &mut [f64], damped: bool) -> Result<(), f64> {
        let group = &self.groups[index];
        let Some((mut residuals, mut tolerances, mut jacobian)) = self.evaluate(index, rows, pose) else {
            return Err(f64::INFINITY);
        };
        let solved = |r: &DVector<f64>, t: &[f64]| r.iter().zip(t).all(|(r, t)| r.abs() <= *t);
        let mut before = vec![0.0; group.columns.len()];
        let mut damping = 1e-3;
        let mut idle = 0;
        for _ in 0..if damped { MOST_ITERATIONS } else { 0 } {
            if solved(&residuals, &tolerances) || idle > 12 {
                break;
            }
            let transposed = jacobian.transpose();
            let mut normal = &transposed * &jacobian;
            let largest = normal.diagonal().max();
            for i in 0..normal.nrows() {
                normal[(i, i)] += damping * normal[(i, i)].max(1e-14 * largest);
            }
            let step = normal.cholesky().map(|c| c.solve(&(&transposed * &residuals)));
            let tried = step.and_then(|step| {
                Self::move_by(group, pose, &step, &mut before);
                let tried = self.evaluate(index, rows, pose).filter(|(r, ..)| r.norm() < residuals.norm());
                if tried.is_none() {
                    Self::move_back(group, pose, &before);
                }
                tried
            });
            match tried {
                Some((r, t, j)) => {
                    idle = if r.norm() < 0.999 * residuals.norm() { 0 } else { idle + 1 };
                    (residuals, tolerances, jacobian) = (r, t, j);
                    damping = (damping * 0.1_f64).max(1e-15);
                }
                None => {
                    idle += 1;
                    damping = (damping * 6.0_f64).max(1e-12);
                }
            }
        }
        // Newton's own steps reach the rounding level, which the normal equations may not.
        for _ in 0..POLISHINGS {
            if residuals.amax() == 0.0 || (self.coarsest > 0.0 && solved(&residuals, &tolerances)) {
                break;
            }
            let Some(step) = jacobian.clone().lu().solve(&residuals) else { break };
            if !step.iter().all(|d| d.is_finite()) {
                break;
            }
            Self::move_by(group, pose, &step, &mut before);
            // Written so that a norm that is no number moves back.
            let closer = self.evaluate(index, rows, pose).filter(|(r, ..)| r.norm() < residuals.norm());
            let Some((r, t, j)) = closer else {
                Self::move_back(group, pose, &before);
                break;
            };
            (residuals, tolerances, jacobian) = (r, t, j);
        }
        if solved(&residuals, &tolerances) { Ok(()) } else { Err(residuals.amax()) }
    }
}

/// Angle of a body's x-axis from the two of its hinted points that are farthest apart in it.
fn direction(hints: &[([f64; 2], [f64; 2])]) -> Option<f64> {
    let (from, rest) = hints.split_first()?;
    let span = |h: &([f64; 2], [f64; 2])| libm::hypot(h.0[0] - from.0[0], h.0[1] - from.0[1]);
    let to = rest.iter().max_by(|a, b| span(a).total_cmp(&span(b))).filter(|to| span(to) > 0.0)?;
    let angle = |a: [f64; 2], b: [f64; 2]| libm::atan2(b[1] - a[1], b[0] - a[0]);
    Some(wrapped(angle(from.1, to.1) - angle(from.0, to.0)))
}
