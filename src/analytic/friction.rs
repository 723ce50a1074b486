//! What rubs, in the equations of balance: a couple against the turning of a journal, a force against sliding.
//!
//! A pin's couple is its friction circle times the size of the pin's force, a slide's force the coefficient times the
//! size of its normal force; both sizes are those of the multipliers, so that balance is no longer linear. It is solved
//! by Newton's iteration while friction grows from nothing to its full strength: where the determinant changes its sign
//! on the way in a group, or no balance is found at however small a step, the pairs lock. What nothing presses does not
//! rub, and locks nothing. Then every pattern of senses of the normal
//! forces is tried, to see whether another balance exists.

use super::AnalyticError;
use super::constraints::{Drive, Formulas, Num, Row, Site, Straight};
use super::linear::System;
use super::model::{Model, Tie, Track};
use super::ordering::{Ordering, order};
use super::statics::{Acting, Balance, Balancing, Burden};
use super::tape::{Calculus, Leaf, Linear, U, Var, minus};
use crate::mechanism::Rider;
use crate::mechanism::friction::{FrictionCircle, Roughness, RubbingPair};

/// At most so many sliding pairs have their senses tried in every pattern.
const MOST_PATTERNS: usize = 8;

/// The least step by which friction grows before the pairs count as locked.
const LEAST_STEP: f64 = 1.0 / 16_777_216.0;
/// The least step by which friction circles grow where another balance is looked for.
const LEAST_STEP_OF_CIRCLES: f64 = 1.0 / 1024.0;
/// So many times larger than a balance is where another one is looked for.
const BEYOND: f64 = 1e6;
/// The step with which it begins to grow.
const FIRST_STEP: f64 = 0.125;
/// Iterations of one step.
const ITERATIONS: usize = 40;
/// Two balances whose multipliers differ by no more than this part of the largest are one.
const SAME: f64 = 1e-6;
/// Newton's iteration ends where no multiplier moves by more than this part of the largest.
const SETTLED: f64 = 1e-13;
/// Error of what friction adds to the matrix, in units of its own rounding.
const OF_FRICTION: f64 = 64.0;

/// How rough a pair is.
#[derive(Debug, Clone, Copy)]
enum Rough {
    /// tan φ.
    Coefficient(Num),
    /// φ.
    Angle(Num),
}

/// A friction circle.
#[derive(Debug, Clone, Copy)]
enum Circle {
    Radius(Num),
    Journal(Num, Rough),
}

/// Where two bodies rub.
#[derive(Debug, Clone, Copy)]
enum Place {
    Pin { carrier: usize, link: usize, circle: Circle },
    Slide { rider: Site, track: Track, normal: usize, rough: Option<Rough>, drag: Option<Num> },
}

/// Two bodies that rub.
#[derive(Debug, Clone, Copy)]
pub(super) struct Rubbing {
    /// The pair.
    pub(super) pair: RubbingPair,
    /// The joint through which its forces pass.
    pub(super) tie: Tie,
    place: Place,
}

/// How far a rider has slid along a straight guide, in any numbers.
pub(super) fn slid<S: Formulas>(scope: &S, rider: Site, line: Straight) -> S::Number {
    let zero = Num::Exact(0.0);
    let drive = Drive { value: zero, rate: zero, arm: None, second: zero };
    scope.row(&Row::Push(rider, line, drive))
}

/// Senses and strength of friction in one balance.
#[derive(Debug, Clone, Default)]
pub(super) struct Strength {
    /// In which sense each pair moves, +1 or −1, in the order of [`super::statics::Burden::rubbing`].
    pub(super) senses: Vec<f64>,
    /// From 0, nothing rubs, to 1.
    pub(super) part: f64,
    /// How much of their radius friction circles lack, from 0, nothing, to 1, all of it.
    pub(super) shrunk: f64,
    /// Senses that the normal forces of the first sliding pairs are taken to have, whatever they have.
    pub(super) pushed: Vec<f64>,
    /// In which sense teeth drive that push their wheels apart, +1 or −1, or 0 where their force itself tells it; none where
    /// they do not push.
    pub(super) meshes: Vec<f64>,
}

impl Rubbing {
    /// All pairs that rub. `pairs` are the equations of all pairs of the model.
    pub(super) fn all(model: &mut Model, pairs: &[(Row, Tie)]) -> Result<Vec<Self>, AnalyticError> {
        let mechanism = std::sync::Arc::clone(&model.mechanism);
        let length = model.length;
        let force = length / (model.time * model.time);
        let mut all = Vec::new();
        for pair in mechanism.rubbing_pairs() {
            let rough = |model: &mut Model, roughness: Roughness| match roughness {
                Roughness::Coefficient(f) => Rough::Coefficient(model.given(f, 1.0)),
                Roughness::Angle(angle) => Rough::Angle(model.given(angle, 1.0)),
            };
            let (tie, place) = match pair {
                RubbingPair::Pin { pin, carrier, link } => {
                    let circle = match mechanism.forces.friction.circle(pin) {
                        None => continue,
                        Some(FrictionCircle::Radius(radius)) => Circle::Radius(model.given(radius, length)),
                        Some(FrictionCircle::Journal { radius, roughness }) => {
                            let radius = model.given(radius, length);
                            Circle::Journal(radius, rough(model, roughness))
                        }
                    };
                    (Tie::Pin(pin), Place::Pin { carrier: carrier.0, link: link.0, circle })
                }
                RubbingPair::Slide(slide) => {
                    let given = &mechanism.slides[slide];
                    let Some(resistance) = mechanism.forces.friction.resistance(slide) else { continue };
                    let rider = model.rider_site(&given.rider, given.guide.link)?;
                    let malformed = |what: &str| AnalyticError::Malformed { what: what.to_owned() };
                    let track = *model.track(slide).ok_or_else(|| malformed("a guide without a path"))?;
                    let row = match track {
                        Track::Line(line) => Row::OnLine(rider, line),
                        Track::Arc(arc) => Row::OnArc(rider, arc),
                    };
                    let normal = pairs.iter().position(|(known, _)| *known == row);
                    let normal = normal.ok_or_else(|| malformed("a guide without an equation"))?;
                    let tie = match given.rider {
                        Rider::Pin { point, block: None } => Tie::Pin(point),
                        Rider::Pin { .. } | Rider::Link { .. } => Tie::Slide(slide),
                    };
                    let rough = resistance.roughness().map(|roughness| rough(model, roughness));
                    let drag = resistance.drag().map(|drag| model.given(drag, force));
                    (tie, Place::Slide { rider, track, normal, rough, drag })
                }
            };
            all.push(Self { pair, tie, place });
        }
        Ok(all)
    }

    /// How far the pair has turned or slid, in any numbers: the link on its carrier, the rider along its guide.
    pub(super) fn moved<S: Formulas>(&self, scope: &S) -> S::Number {
        match &self.place {
            Place::Pin { carrier, link, .. } => scope.angle(*link) - scope.angle(*carrier),
            Place::Slide { rider, track: Track::Line(line), .. } => slid(scope, *rider, *line),
            Place::Slide { rider, track: Track::Arc(arc), .. } => {
                let from = minus(scope.site(rider), scope.site(&arc.centre));
                let turned = from[1].atan2(from[0]) - scope.angle(arc.centre.body);
                turned * scope.num(arc.radius)
            }
        }
    }

    /// The two bodies.
    pub(super) fn bodies(&self) -> [usize; 2] {
        match &self.place {
            Place::Pin { carrier, link, .. } => [*carrier, *link],
            Place::Slide { rider, track: Track::Line(line), .. } => [line.through.body, rider.body],
            Place::Slide { rider, track: Track::Arc(arc), .. } => [arc.centre.body, rider.body],
        }
    }

    /// The multipliers on which its friction hangs.
    pub(super) fn hangs_on(&self, pairs: &[(Row, Tie)]) -> Vec<usize> {
        match &self.place {
            Place::Slide { normal, rough, .. } => rough.iter().map(|_| *normal).collect(),
            Place::Pin { .. } => {
                let of_pin = pairs.iter().enumerate().filter(|(_, (_, tie))| *tie == self.tie);
                of_pin.map(|(index, _)| index).collect()
            }
        }
    }

    /// The multipliers without which nothing presses the pair, so that it does not rub; none where it rubs whatever they
    /// are.
    fn pressed_by(&self, all: &[Self], pairs: &[(Row, Tie)]) -> Vec<usize> {
        let Place::Pin { link, .. } = self.place else { return self.hangs_on(pairs) };
        // What drags a pin along its slot presses it as well.
        let drags = |other: &Self| matches!(other.place, Place::Slide { drag: Some(_), .. });
        if all.iter().any(|other| other.tie == self.tie && drags(other)) {
            return Vec::new();
        }
        let of_link = |at: &usize| link == 0 || pairs[*at].0.hangs_on(link);
        self.hangs_on(pairs).into_iter().filter(of_link).collect()
    }

    /// The multiplier of the normal force of a guide that is rough.
    pub(super) fn normal(&self) -> Option<usize> {
        match &self.place {
            Place::Slide { normal, rough: Some(_), .. } => Some(*normal),
            _ => None,
        }
    }
}

impl<'t> Acting<'t> {
    /// tan φ.
    fn tangent(&self, rough: Rough) -> Var<'t> {
        match rough {
            Rough::Coefficient(f) => self.real.num(f).v,
            Rough::Angle(angle) => {
                let [cos, sin] = self.real.num(angle).v.cos_sin();
                sin / cos
            }
        }
    }

    /// Radius of a friction circle, r sin φ.
    fn circle(&self, circle: Circle) -> Var<'t> {
        match circle {
            Circle::Radius(radius) => self.real.num(radius).v,
            Circle::Journal(radius, rough) => {
                let radius = self.real.num(radius).v;
                let sine = match rough {
                    Rough::Coefficient(f) => {
                        let f = self.real.num(f).v;
                        let one = self.real.tape.constant(1.0);
                        f / (one + f * f).sqrt()
                    }
                    Rough::Angle(angle) => self.real.num(angle).v.cos_sin()[1],
                };
                radius * sine
            }
        }
    }

    /// The size of a vector; zero, without a slope, where it has none.
    fn size(&self, [x, y]: [Var<'t>; 2]) -> Var<'t> {
        if x.value == 0.0 && y.value == 0.0 {
            return self.real.tape.constant(0.0);
        }
        (x * x + y * y).sqrt()
    }

    /// The friction of a pair: the couple on the link that turns, or the force on the rider along its guide; against
    /// the motion, so never with its sense. None in a balance without friction.
    fn friction(&self, index: usize, rubbing: &Rubbing) -> Option<Var<'t>> {
        let tape = self.real.tape;
        let sense = *self.strength.senses.get(index)?;
        let against = tape.constant(-sense * self.strength.part);
        let size = match rubbing.place {
            Place::Pin { link, carrier, circle } => {
                let zero = tape.constant(0.0);
                let of_pin = |_: &Row, tie: Tie| tie == rubbing.tie;
                // The frame has no coordinates: its force is that of all others.
                let (body, bodies) =
                    if link != 0 { (link, link..link + 1) } else { (0, 1..self.model.bodies) };
                debug_assert!(body != carrier, "a link does not rub on itself");
                let mut sum = [zero; 2];
                for body in bodies {
                    let [x, y, _] = self.wrench(of_pin, body, [zero; 2]);
                    sum = [sum[0] + x, sum[1] + y];
                    // A slot in which the pin rides rubs on it as well.
                    let slots = |other: &Rubbing| {
                        other.tie == rubbing.tie && matches!(other.place, Place::Slide { .. })
                    };
                    if let Some([x, y, _]) = self.friction_on(slots, body, [zero; 2]) {
                        sum = [sum[0] + x, sum[1] + y];
                    }
                }
                let left = tape.constant(1.0 - self.strength.shrunk);
                self.circle(circle) * self.size(sum) * left
            }
            Place::Slide { rider, track, normal, rough, drag } => {
                let force = self.unknown(normal);
                let pushed = self.place_among_slides(index).and_then(|at| self.strength.pushed.get(at));
                let normal_size = match pushed {
                    Some(sense) => force * tape.constant(*sense),
                    None => force.abs(),
                };
                let normal_size = match track {
                    Track::Line(_) => normal_size,
                    // The equation of an arc has a slope of its own.
                    Track::Arc(arc) => {
                        let row = Row::OnArc(rider, arc);
                        let slopes = [0, 1].map(|axis| self.slope(&row, 3 * rider.body + axis));
                        normal_size * self.size(slopes)
                    }
                };
                let of_normal = rough.map(|rough| self.tangent(rough) * normal_size);
                let drag = drag.map(|drag| self.real.num(drag).v);
                match (of_normal, drag) {
                    (Some(a), Some(b)) => a + b,
                    (one, other) => one.or(other).unwrap_or_else(|| tape.constant(0.0)),
                }
            }
        };
        Some(size * against)
    }

    /// The place of a pair among the sliding ones whose guides are rough.
    fn place_among_slides(&self, index: usize) -> Option<usize> {
        let rough = |rubbing: &Rubbing| rubbing.normal().is_some();
        let all = &self.burden.rubbing;
        rough(&all[index]).then(|| all[..index].iter().filter(|rubbing| rough(rubbing)).count())
    }

    /// The virtual work of all friction, where one coordinate has a unit virtual rate.
    pub(super) fn friction_work(&self, column: usize) -> Option<Var<'t>> {
        let body = column / 3;
        let virtually = self.virtually(column);
        let mut sum: Option<Var<'t>> = None;
        for (index, rubbing) in self.burden.rubbing.iter().enumerate() {
            if !rubbing.bodies().contains(&body) {
                continue;
            }
            let work = self.friction(index, rubbing)? * rubbing.moved(&virtually).d;
            sum = Some(match sum {
                Some(sum) => sum + work,
                None => work,
            });
        }
        sum
    }

    /// What friction in the chosen joints exerts on a body: force, and moment about a place.
    pub(super) fn friction_on(
        &self,
        chosen: impl Fn(&Rubbing) -> bool,
        body: usize,
        about: [Var<'t>; 2],
    ) -> Option<[Var<'t>; 3]> {
        let zero = self.real.tape.constant(0.0);
        let mut sum: Option<[Var<'t>; 3]> = None;
        for (index, rubbing) in self.burden.rubbing.iter().enumerate() {
            let [held, moving] = rubbing.bodies();
            if !chosen(rubbing) || ![held, moving].contains(&body) {
                continue;
            }
            let sign = self.real.tape.constant(if body == moving { 1.0 } else { -1.0 });
            let size = self.friction(index, rubbing)? * sign;
            let wrench = match &rubbing.place {
                Place::Pin { .. } => [zero, zero, size],
                Place::Slide { rider, track, .. } => {
                    let at = self.real.site(rider);
                    let along = match track {
                        Track::Line(line) => self.real.direction(line).map(|c| c.v),
                        Track::Arc(arc) => {
                            let from = minus(at, self.real.site(&arc.centre)).map(|c| c.v);
                            let length = self.size(from);
                            [-from[1] / length, from[0] / length]
                        }
                    };
                    let [x, y] = along.map(|c| c * size);
                    let arm = [at[0].v - about[0], at[1].v - about[1]];
                    [x, y, arm[0] * y - arm[1] * x]
                }
            };
            sum = Some(match sum {
                Some(sum) => [0, 1, 2].map(|i| sum[i] + wrench[i]),
                None => wrench,
            });
        }
        sum
    }

    /// The power of all friction, never positive.
    pub(super) fn friction_power(&self) -> Option<Var<'t>> {
        let rubbing = self.burden.rubbing.iter().enumerate();
        let part = |(index, rubbing): (usize, &Rubbing)| {
            Some(self.friction(index, rubbing)? * rubbing.moved(&self.real).d)
        };
        rubbing.filter_map(part).reduce(|a, b| a + b)
    }
}

/// A pair that does not move.
pub(super) fn say_at_rest(model: &Model, pair: RubbingPair) -> String {
    format!("{} does not move: its friction has no sense", model.mechanism.say_rubbing(pair))
}

/// What becomes of a balance with friction.
pub(super) enum Found {
    /// The only one.
    One(Vec<f64>),
    /// None; the pairs that lock, and at which part of the stated friction.
    Locked(Vec<RubbingPair>, f64),
    /// More than one.
    Several,
    /// Not even without friction.
    Singular,
}

/// The search for balances with friction: equations, unknowns and the groups in which they are solved.
struct Search<'a> {
    balancing: &'a Balancing<'a>,
    ordering: Ordering,
    undetermined: Vec<bool>,
    /// Without friction: where friction begins to grow.
    smooth: Vec<f64>,
    /// The senses of teeth, which their own forces tell: friction may turn one round.
    meshes: Vec<f64>,
    /// The multipliers that press each pair that rubs; none where it rubs whatever they are.
    pressed_by: Vec<Vec<usize>>,
}

/// Where Newton's iteration comes to its end.
struct Settled {
    /// The multipliers, and what is sought.
    x: Vec<f64>,
    /// By how much rounding may have moved each of them.
    rounded: Vec<f64>,
    /// Whether the determinant of each group is positive.
    positive: Vec<bool>,
}

impl Search<'_> {
    /// Newton's iteration at one strength of friction. None where it does not end.
    fn newton(&self, from: &[f64], strength: &Strength) -> Result<Option<Settled>, AnalyticError> {
        let mut x = from.to_vec();
        let mut last = f64::INFINITY;
        for _ in 0..ITERATIONS {
            let rows = self.balancing.evaluate(&x, strength, None)?;
            let system = self.system(&rows);
            if system.blocks.iter().any(|block| block.inverse.is_none()) {
                return Ok(None);
            }
            let residuals: Vec<f64> = rows.iter().map(|linear| -linear.value).collect();
            let correction = system.solve(&residuals, &self.undetermined);
            for (x, d) in x.iter_mut().zip(&correction) {
                *x += d;
            }
            if x.iter().any(|x| !x.is_finite()) {
                return Ok(None);
            }
            let (size, moved) = (largest(&x), largest(&correction));
            // What moves no less than before, and by next to nothing, is rounding.
            if moved <= SETTLED * size || (moved >= last && moved <= SAME * SAME * size) {
                let rounding: Vec<f64> = rows.iter().map(|linear| linear.rounding).collect();
                let rounded = system.moved_by(&rounding);
                let positive = self.senses(&x, &rounded, (strength, system))?;
                return Ok(Some(Settled { x, rounded, positive }));
            }
            last = moved;
        }
        Ok(None)
    }

    /// The equations in their groups.
    fn system(&self, rows: &[Linear]) -> System {
        System::new(self.ordering.groups.clone(), rows, self.smooth.len(), multiplier)
    }

    /// Whether the determinant of each group is positive. What nothing presses does not rub: a force that is none but for
    /// rounding has no direction for its friction, and whichever rounding gives it would have a determinant of its own.
    fn senses(
        &self,
        x: &[f64],
        rounded: &[f64],
        (strength, mut system): (&Strength, System),
    ) -> Result<Vec<bool>, AnalyticError> {
        let mut pressed = strength.clone();
        for (sense, by) in pressed.senses.iter_mut().zip(&self.pressed_by) {
            if !by.is_empty() && by.iter().all(|at| x[*at].abs() <= rounded[*at]) {
                *sense = 0.0;
            }
        }
        if pressed.senses != strength.senses {
            system = self.system(&self.balancing.evaluate(x, &pressed, None)?);
        }
        Ok(system.blocks.iter().map(|block| block.jacobian.determinant() > 0.0).collect())
    }

    /// Lets friction grow to its full strength. Where it locks: at which part of it.
    fn grow(&self, senses: &[f64]) -> Result<Result<Vec<f64>, f64>, AnalyticError> {
        let at = |part: f64| Strength {
            senses: senses.to_vec(),
            part,
            shrunk: 0.0,
            pushed: Vec::new(),
            meshes: self.meshes.clone(),
        };
        let Some(Settled { mut x, positive, .. }) = self.newton(&self.smooth, &at(0.0))? else {
            return Ok(Err(0.0));
        };
        let (mut part, mut step) = (0.0, FIRST_STEP);
        while part < 1.0 {
            let next = (part + step).min(1.0);
            match self.newton(&x, &at(next))? {
                Some(found) if found.positive == positive => (x, part) = (found.x, next),
                _ => {
                    step *= 0.5;
                    if step < LEAST_STEP {
                        return Ok(Err(part));
                    }
                }
            }
        }
        Ok(Ok(x))
    }

    /// Whether another balance exists, by every pattern of senses of the normal forces.
    fn another(&self, senses: &[f64], than: &[f64]) -> Result<bool, AnalyticError> {
        let rough = self.balancing.burden.rubbing.iter().filter_map(Rubbing::normal);
        let normals: Vec<usize> = rough.take(MOST_PATTERNS).collect();
        for pattern in 0..1_u32 << normals.len() {
            let pushed: Vec<f64> =
                (0..normals.len()).map(|i| if pattern >> i & 1 == 0 { 1.0 } else { -1.0 }).collect();
            let strength = |shrunk: f64| Strength {
                senses: senses.to_vec(),
                part: 1.0,
                shrunk,
                pushed: pushed.clone(),
                meshes: self.meshes.clone(),
            };
            let other = |Settled { x, rounded, .. }: &Settled| {
                let fits = normals.iter().zip(&pushed).all(|(at, sense)| x[*at] * sense >= -rounded[*at]);
                let apart: Vec<f64> = x.iter().zip(than).map(|(a, b)| a - b).collect();
                fits && largest(&apart) > SAME * largest(x).max(largest(than))
            };
            // From the known balance, and from where all forces of pairs and efforts are turned round and far larger:
            // that is how pins whose circles reach past the arms of their forces find their other balance.
            let beyond = [1.0, -1.0].map(|sign| than.iter().map(|x| sign * BEYOND * x).collect::<Vec<f64>>());
            for from in [than, &beyond[0], &beyond[1]] {
                if let Some(found) = self.newton(from, &strength(0.0))?
                    && other(&found)
                {
                    return Ok(true);
                }
            }
            if self.swollen(than, strength)?.is_some_and(|found| other(&found)) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// A balance with given senses of normal forces. With points in the place of friction circles it is linear; from there
    /// the circles grow to their size. None where the way ends before.
    fn swollen(
        &self,
        from: &[f64],
        strength: impl Fn(f64) -> Strength,
    ) -> Result<Option<Settled>, AnalyticError> {
        let Some(mut found) = self.newton(from, &strength(1.0))? else { return Ok(None) };
        let (mut shrunk, mut step) = (1.0, FIRST_STEP);
        while shrunk > 0.0 {
            let next = (shrunk - step).max(0.0);
            match self.newton(&found.x, &strength(next))? {
                Some(next_found) => (found, shrunk) = (next_found, next),
                None => {
                    step *= 0.5;
                    if step < LEAST_STEP_OF_CIRCLES {
                        return Ok(None);
                    }
                }
            }
        }
        Ok(Some(found))
    }

    fn found(&self, senses: &[f64]) -> Result<Found, AnalyticError> {
        match self.grow(senses)? {
            Ok(x) if self.another(senses, &x)? => Ok(Found::Several),
            Ok(x) => Ok(Found::One(x)),
            Err(0.0) => Ok(Found::Singular),
            Err(part) => {
                // Those without one of which nothing locks; all where it takes several of them.
                let all: Vec<RubbingPair> = self.balancing.burden.rubbing.iter().map(|r| r.pair).collect();
                let mut guilty = Vec::new();
                for (index, pair) in all.iter().enumerate() {
                    let mut without = senses.to_vec();
                    without[index] = 0.0;
                    if self.grow(&without)?.is_ok() {
                        guilty.push(*pair);
                    }
                }
                Ok(Found::Locked(if guilty.is_empty() { all } else { guilty }, part))
            }
        }
    }
}

fn largest(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |most, x| x.abs().max(most))
}

fn multiplier(leaf: Leaf) -> Option<usize> {
    match leaf {
        Leaf::Force(at) => Some(at),
        Leaf::Pose(_) | Leaf::Rate(_) | Leaf::Accel(_) | Leaf::Param(_) => None,
    }
}

/// Solves a balance in which pairs rub; `senses` of their motions, in their order.
pub(super) fn balance(
    balancing: &Balancing<'_>,
    senses: Vec<f64>,
) -> Result<(Found, Balance), AnalyticError> {
    let burden: &Burden = balancing.burden;
    let n = burden.unknowns();
    let Balance { x: smooth, strength: Strength { meshes, .. }, .. } = super::statics::balance(balancing)?;
    let without = Strength { meshes: meshes.clone(), ..Strength::default() };
    let (_, mut known) = balancing.linear(&vec![0.0; n], &without)?;
    // Every balance of a body that rubs hangs on the forces of the pair, whatever their size is now.
    for rubbing in &burden.rubbing {
        let hangs_on = rubbing.hangs_on(&burden.pairs);
        for body in rubbing.bodies().into_iter().filter(|body| *body != 0) {
            for axis in 0..3 {
                known.pattern[3 * body + axis - 3].extend(&hangs_on);
            }
        }
    }
    for row in &mut known.pattern {
        row.sort_unstable();
        row.dedup();
    }
    let ordering = order(&known.pattern, n);
    let mut undetermined = vec![false; n];
    for column in &ordering.free {
        undetermined[*column] = true;
    }
    let told = vec![0.0; meshes.len()];
    let pressed_by = |rubbing: &Rubbing| rubbing.pressed_by(&burden.rubbing, &burden.pairs);
    let pressed_by = burden.rubbing.iter().map(pressed_by).collect();
    let search = Search { balancing, ordering, undetermined, smooth, meshes: told, pressed_by };
    let found = search.found(&senses)?;
    let x = match &found {
        Found::One(x) => x.clone(),
        Found::Locked(..) | Found::Several | Found::Singular => vec![0.0; n],
    };
    let meshes = if matches!(found, Found::One(_)) { burden.driven(&x) } else { meshes };
    let strength = Strength { senses, part: 1.0, shrunk: 0.0, pushed: Vec::new(), meshes };
    let rows: Vec<Linear> = balancing.evaluate(&x, &strength, None)?;
    let Search { ordering, mut undetermined, .. } = search;
    let mut system = System::new(ordering.groups, &rows, n, multiplier);
    for index in 0..system.blocks.len() {
        let entries = &system.entries;
        let error = |row: usize, column: usize| {
            let of_friction = entries[row].iter().filter(|(at, _)| *at == column);
            let of_friction: f64 = of_friction.map(|(_, value)| OF_FRICTION * U * value.abs()).sum();
            // A balance that does not hang on the unknown but by friction.
            let given = known.errors.get(&(row, column)).into_iter().sum::<f64>();
            given + of_friction
        };
        let regular = system.is_regular(index, error);
        if !regular {
            system.blocks[index].inverse = None;
        }
        if !regular || system.uses(index, &undetermined) {
            for column in &system.blocks[index].group.columns {
                undetermined[*column] = true;
            }
        }
    }
    if !matches!(found, Found::One(_)) {
        undetermined.fill(true);
    }
    let unbalanced = balancing.unbalanced(&undetermined);
    Ok((found, Balance { x, rows, system, undetermined, unbalanced, strength }))
}
