//! A sweep against the independent solver, at a stated handful of positions.
//!
//! A sweep is one drawing that is run many times: what is wrong with it shows at its ends and where something happens. So
//! it is compared where each stretch begins and ends, at the scene's own place, at events, and where these leave long gaps;
//! at most [`MOST_POSITIONS`] positions, since the independent solver costs more for one position than the sweep for some
//! thousand.
//!
//! At the scene's own place the independent solver is given the scene alone, and finds the assembly for itself. Elsewhere it is
//! told which of its assemblies is meant: it begins from where the drawing has the points, and what it finds there closes by its
//! own equations, with rates of its own. That the mechanism gets there from the scene's own place is the drawing's word: along a
//! stretch every meet keeps its side. Where wheels carry points it is followed besides (`carried.rs`).
//!
//! A torsion spring is wound up by what its links have turned since the scene's own place. No equation of one position tells
//! that: the independent solver is led there by short steps, and the angles that it finds are added up.

use std::f64::consts::TAU;

use crate::analytic::{self, AnalyticError};
use crate::mechanism::force::{SpringKind, SpringLaw};
use crate::mechanism::quantity::{Answer, Indeterminate, Quantity, Stuck};
use crate::mechanism::{Input, LinkId, Mechanism};
use crate::sweep::{EventKind, Stretch, Sweep};

use super::carried::{self, CarriedAstray};

/// A sweep is compared at so many positions at most.
pub const MOST_POSITIONS: usize = 16;

/// At the end of a stretch two arcs touch, and speeds grow without end: it is compared this part of its length inside.
const INSIDE: f64 = 1e-3;

/// Over a part of the range that is longer than this nothing is left uncompared, as long as there are positions left.
const LONGEST_GAP: f64 = 1.0 / 6.0;

/// Where in a gap it is compared: nowhere that a scene of round numbers would have chosen.
const IN_GAP: f64 = 0.44;

/// Nearer than this part of its period to a knot of a curve one may be on either side of it.
const KNOT: f64 = 1e-12;

/// A number of a sweep is known within so many of its errors: by as much as it must exceed zero.
const ERRORS: f64 = 8.0;

/// A number that the independent solver does not confirm.
#[derive(Debug, Clone, PartialEq)]
pub struct SweptApart {
    /// Index of the column.
    pub column: usize,
    /// Where, SI units.
    pub at: f64,
    /// What the sweep says, SI units.
    pub swept: f64,
    /// What the independent solver says.
    pub analytic: f64,
    /// How far they may be apart.
    pub allowed: f64,
}

/// Why a sweep is not confirmed.
#[derive(Debug, Clone, PartialEq)]
pub enum SweepUnconfirmed {
    /// A number is another.
    Number(SweptApart),
    /// The independent solver has no position there.
    Refused {
        /// Where, SI units.
        at: f64,
        /// Why.
        why: AnalyticError,
    },
    /// The sweep has a number where friction lets no balance exist, or more than one.
    Stuck {
        /// Where, SI units.
        at: f64,
        /// How.
        how: Stuck,
        /// Which pairs rub.
        why: String,
    },
    /// The points of a wheel are not where it has rolled them.
    Carried(CarriedAstray),
}

/// Compares a sweep with the independent solver. Gives at how many positions they were compared.
///
/// # Errors
/// The first number that is not confirmed.
pub fn confirm_sweep(sweep: &Sweep) -> Result<usize, SweepUnconfirmed> {
    let ends = positions(sweep);
    let mut places = ends.clone();
    fill_gaps(sweep, &mut places);
    let wound = wound_up(sweep, &places);
    for (&at, wound) in places.iter().zip(&wound) {
        match confirm_at(sweep, at, wound.as_deref()) {
            // On the way several balances with friction may fit where the drawing has one that does.
            Err(SweepUnconfirmed::Stuck { how: Stuck::Ambiguous, .. }) if !ends.contains(&at) => {}
            confirmed => confirmed?,
        }
    }
    if sweep.is_carried_along() {
        for &at in &places {
            carried::moves_as_it_rolls(sweep, at)?;
        }
        carried::nothing_leaps(sweep)?;
    }
    Ok(places.len())
}

/// Where angles are added up, a step goes over so many of the places at which a sweep looks.
const EVERY: f64 = 16.0;

/// A step in which a link turns by more than this is halved, radians.
const LONGEST_TURN: f64 = 1.0;

/// Halvings of a step.
const HALVINGS: u32 = 6;

/// How far each torsion spring with a stiffness is turned from where it has no load, by the independent solver: led from the
/// scene's own place to each of these, ascending. `None` where nothing has to be added up, or where it is not led to.
fn wound_up(sweep: &Sweep, places: &[f64]) -> Vec<Option<Vec<f64>>> {
    let mut wound = vec![None; places.len()];
    let Some(begin) = sweep.marked_at(sweep.start).filter(|mechanism| !torsion_springs(mechanism).is_empty())
    else {
        return wound;
    };
    let Some(at_start) = turned_further(&begin) else { return wound };
    let within_half_a_turn: Vec<f64> = at_start.iter().map(|angle| wrapped(*angle)).collect();
    let looks = f64::from(sweep.looks().max(1));
    let longest = (sweep.range[1] - sweep.range[0]) * EVERY / looks;
    let up = places.iter().enumerate().filter(|(_, at)| **at >= sweep.start);
    let down = places.iter().enumerate().filter(|(_, at)| **at < sweep.start).rev();
    for way in [up.collect::<Vec<_>>(), down.collect()] {
        let (mut at, mut angles) = (sweep.start, within_half_a_turn.clone());
        for (index, &to) in way {
            let Some(there) = led(sweep, (at, &angles), to, longest) else { break };
            (at, angles) = (to, there);
            wound[index] = Some(angles.clone());
        }
    }
    if sweep.whole_turn {
        // What is not come to one way round is come to the other way round.
        let turn = sweep.range[1] - sweep.range[0];
        for (wound, at) in wound.iter_mut().zip(places).filter(|(wound, _)| wound.is_none()) {
            let round = if *at > sweep.start { at - turn } else { at + turn };
            *wound = led(sweep, (sweep.start, &within_half_a_turn), round, longest);
        }
    }
    wound
}

/// A place within the range of a sweep; of an input that goes round within its turn.
fn home(sweep: &Sweep, at: f64) -> f64 {
    let [from, to] = sweep.range;
    if !sweep.whole_turn || (from..=to).contains(&at) {
        return at;
    }
    from + (at - from).rem_euclid(to - from)
}

/// The angles of torsion springs at another place of the input, led there by short steps.
fn led(sweep: &Sweep, (from, angles): (f64, &[f64]), to: f64, longest: f64) -> Option<Vec<f64>> {
    let (mut at, mut angles) = (from, angles.to_vec());
    while at != to {
        let left = to - at;
        let mut goal = if left.abs() <= longest { to } else { at + longest.copysign(left) };
        let mut halvings = 0;
        angles = loop {
            let there = turned_further(&sweep.marked_at(home(sweep, goal))?)?;
            let on: Vec<f64> = angles.iter().zip(&there).map(|(before, now)| wrapped(now - before)).collect();
            if on.iter().all(|by| by.abs() <= LONGEST_TURN) {
                break angles.iter().zip(on).map(|(before, by)| before + by).collect();
            }
            halvings += 1;
            if halvings > HALVINGS {
                return None;
            }
            goal = f64::midpoint(at, goal);
        };
        at = goal;
    }
    Some(angles)
}

/// The torsion springs with a stiffness: their index, their links and their angle without load.
fn torsion_springs(mechanism: &Mechanism) -> Vec<(usize, [LinkId; 2], f64)> {
    let springs = mechanism.forces.springs.iter().enumerate();
    let torsion = springs.filter_map(|(index, spring)| match (spring.kind, spring.law) {
        (SpringKind::Torsion(links), SpringLaw::Stiffness { free, .. }) => Some((index, links, free.value)),
        _ => None,
    });
    torsion.collect()
}

/// How much further the links of each torsion spring are turned against each other than without load, but for whole turns,
/// by the independent solver.
fn turned_further(mechanism: &Mechanism) -> Option<Vec<f64>> {
    let springs = torsion_springs(mechanism);
    let moving = springs.iter().flat_map(|(_, links, _)| links).filter(|link| **link != LinkId::FRAME);
    let quantities: Vec<Quantity> = moving.map(|link| Quantity::Angle(*link)).collect();
    let state = analytic::solve_for(mechanism, &quantities).ok()?;
    let angle = |link: LinkId| match state.answer(&Quantity::Angle(link)) {
        _ if link == LinkId::FRAME => Some(0.0),
        Answer::Scalar { value, .. } => Some(value),
        _ => None,
    };
    let further = |(_, [first, second], free): &(usize, [LinkId; 2], f64)| {
        Some(angle(*second)? - angle(*first)? - free)
    };
    springs.iter().map(further).collect()
}

/// The same angle within half a turn.
fn wrapped(angle: f64) -> f64 {
    angle - TAU * (angle / TAU).round()
}

/// Where a sweep is compared.
fn positions(sweep: &Sweep) -> Vec<f64> {
    let mut places = vec![sweep.start];
    let mut last: Option<&Stretch> = None;
    for (index, stretch) in sweep.stretches.iter().enumerate() {
        let inside = (stretch.to - stretch.from) * INSIDE;
        // Where one goes on from the other nothing ends.
        let goes_on = |a: &Stretch, b: &Stretch| a.to == b.from && sweep.is_one_assembly(a, b);
        if !last.is_some_and(|last| goes_on(last, stretch)) {
            places.push(stretch.from + inside);
        }
        if !sweep.stretches.get(index + 1).is_some_and(|next| goes_on(stretch, next)) {
            places.push(stretch.to - inside);
        }
        last = Some(stretch);
    }
    // Just where forces leap a hair decides which of two sizes counts: they are compared on both sides.
    let leaps = |at: f64| sweep.reversals.iter().any(|reversal| reversal.at == at);
    let extremes: Vec<f64> = sweep
        .events
        .iter()
        .filter(|event| matches!(event.kind, EventKind::Least { .. } | EventKind::Greatest { .. }))
        .flat_map(|event| {
            let off = if leaps(event.at) { beside_a_leap(sweep) } else { 0.0 };
            let other = (off > 0.0).then_some(event.at + off);
            std::iter::once(event.at - off).chain(other)
        })
        .collect();
    let room = MOST_POSITIONS.saturating_sub(places.len());
    let step = extremes.len().div_ceil(room.max(1)).max(1);
    places.extend(extremes.into_iter().step_by(step));
    places.retain(|at| sweep.stretch_at(*at).is_some());
    places.sort_by(f64::total_cmp);
    places.dedup();
    places.truncate(MOST_POSITIONS);
    places
}

/// So far beside a leap of forces both solvers see the same side of it.
fn beside_a_leap(sweep: &Sweep) -> f64 {
    INSIDE * (sweep.range[1] - sweep.range[0])
}

/// Adds places where much of a stretch would go uncompared, the longest gap first.
fn fill_gaps(sweep: &Sweep, places: &mut Vec<f64>) {
    let longest_gap = (sweep.range[1] - sweep.range[0]) * LONGEST_GAP;
    while places.len() < MOST_POSITIONS {
        let gaps = places.windows(2).map(|ends| (ends[0], ends[1] - ends[0]));
        let inside = gaps.filter(|(from, gap)| sweep.stretch_at(from + gap * IN_GAP).is_some());
        let Some((from, gap)) = inside.max_by(|a, b| a.1.total_cmp(&b.1)) else { return };
        if gap <= longest_gap {
            return;
        }
        let at = from + gap * IN_GAP;
        places.insert(places.partition_point(|place| *place < at), at);
    }
}

/// Whether the first input stands where the curve of a load may leap: there a hair decides which of two sizes counts.
fn stands_on_a_knot(mechanism: &Mechanism) -> bool {
    let Some(Input::Angle { angle: Some(at), .. } | Input::Speed { angle: Some(at), .. }) =
        mechanism.inputs.first()
    else {
        return false;
    };
    mechanism.forces.knots().iter().any(|[knot, period]| {
        let away = at.value - knot.value;
        let away = away - libm::round(away / period.value) * period.value;
        away != 0.0 && away.abs() <= KNOT * period.value
    })
}

fn confirm_at(sweep: &Sweep, at: f64, wound: Option<&[f64]>) -> Result<(), SweepUnconfirmed> {
    let (Some(values), Some(mut mechanism)) = (sweep.at(at), sweep.marked_at(at)) else { return Ok(()) };
    let quantities: Vec<Quantity> = mechanism.asked.iter().map(|asked| asked.quantity).collect();
    if quantities.is_empty() || stands_on_a_knot(&mechanism) {
        return Ok(());
    }
    for ((index, ..), angle) in torsion_springs(&mechanism).into_iter().zip(wound.unwrap_or_default()) {
        mechanism.forces.springs[index].wound = *angle;
    }
    // Of what is asked alone: other links may be impossible there.
    let state =
        analytic::solve_for(&mechanism, &quantities).map_err(|why| SweepUnconfirmed::Refused { at, why })?;
    let mut last = None;
    for (index, column) in sweep.columns.iter().enumerate().filter(|(_, column)| !column.watched) {
        let Some(swept) = values[index] else { continue };
        let quantity = column.asked.quantity;
        let answer = match &last {
            Some((of, answer)) if *of == quantity => answer,
            _ => &last.insert((quantity, state.answer(&quantity))).1,
        };
        let (analytic, bound) = match (answer, column.axis) {
            (Answer::Scalar { value, bound }, None) => (*value, *bound),
            (Answer::Vector { value, bound }, Some(axis)) => (value[axis], *bound),
            (Answer::Indeterminate(Indeterminate::Rubbing { how, why }), _) if *how != Stuck::AtRest => {
                return Err(SweepUnconfirmed::Stuck { at, how: *how, why: why.clone() });
            }
            // At infinity, or not determined: the sweep has no number there either, or one that says so by its error.
            _ => continue,
        };
        let mut apart = (swept.value - analytic).abs();
        if matches!(quantity, Quantity::Angle(_)) {
            apart = (apart - TAU * (apart / TAU).round()).abs();
        }
        let allowed = bound + ERRORS * swept.error;
        // Written so that a not-a-number is not confirmed.
        let confirmed = apart <= allowed;
        if !confirmed {
            let swept = swept.value;
            return Err(SweepUnconfirmed::Number(SweptApart { column: index, at, swept, analytic, allowed }));
        }
    }
    Ok(())
}
