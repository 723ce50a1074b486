//! What the mechanism does: constraints over the places, solved for the rates.
//!
//! Every body's coordinates are displacements from the instant's pose, so a place of a body is its place in the world.

use nalgebra::{DMatrix, DVector};

use super::jet::{Jet, Moving};
use super::mechanism::{
    Contact, Driver, FRAME, Kind, Mechanism, Path, Place, Rider, dot, left, length, minus,
};

/// Coordinates of all bodies but the frame, three to each.
pub(crate) struct State {
    jets: Vec<Jet>,
    /// Each body turns about this place of its.
    pivots: Vec<Place>,
    /// What the smallest pivot of the equations is to the largest: how far from a dead centre.
    pub(crate) condition: f64,
}

impl State {
    fn body(&self, body: usize) -> [Jet; 3] {
        if body == FRAME {
            return [Jet::default(); 3];
        }
        let at = 3 * (body - 1);
        [self.jets[at], self.jets[at + 1], self.jets[at + 2]]
    }

    /// How far a body has turned.
    pub(crate) fn turn(&self, body: usize) -> Jet {
        self.body(body)[2]
    }

    /// A place of a body.
    pub(crate) fn place(&self, body: usize, at: Place) -> Moving {
        let [x, y, turn] = self.body(body);
        let pivot = self.pivots[body];
        let arm = turned(turn, minus(at, pivot));
        Moving { x: arm.x + x + Jet::constant(pivot[0]), y: arm.y + y + Jet::constant(pivot[1]) }
    }

    /// A direction of a body.
    pub(crate) fn direction(&self, body: usize, along: Place) -> Moving {
        turned(self.turn(body), along)
    }
}

/// A direction that has turned.
fn turned(turn: Jet, along: Place) -> Moving {
    let (c, s) = turn.cos_sin();
    Moving { x: c * along[0] - s * along[1], y: s * along[0] + c * along[1] }
}

/// What holds the bodies together: zero in every position, with its rates.
fn equations(mechanism: &Mechanism, state: &State) -> Vec<Jet> {
    equations_but(mechanism, state, &[])
}

/// The same without saying that these links turn with those on which they ride.
fn equations_but(mechanism: &Mechanism, state: &State, loose: &[[usize; 2]]) -> Vec<Jet> {
    let mut all = Vec::new();
    for point in &mechanism.points {
        let mut of = point.of.iter();
        let Some(first) = of.next() else { continue };
        let here = state.place(*first, point.at);
        for other in of {
            let apart = here.minus(state.place(*other, point.at));
            all.extend([apart.x, apart.y]);
        }
    }
    for (index, body) in mechanism.bodies.iter().enumerate() {
        if body.kind == Kind::Particle {
            all.push(state.turn(index));
        }
    }
    for slide in &mechanism.slides {
        let (point, body) = mechanism.rider(slide);
        let rider = state.place(body, mechanism.at(point));
        match slide.path {
            Path::Line { through, along } => {
                let from = state.place(slide.on, through);
                all.push(state.direction(slide.on, left(along)).dot(rider.minus(from)));
                match slide.rider {
                    Rider::Link(turning) if loose.contains(&[turning, slide.on]) => {}
                    Rider::Pin { block: Some(turning), .. } | Rider::Link(turning) => {
                        all.push(state.turn(turning) - state.turn(slide.on));
                    }
                    Rider::Pin { block: None, .. } => {}
                }
            }
            Path::Arc { centre, radius, .. } => {
                let arm = rider.minus(state.place(slide.on, centre));
                all.push((arm.dot(arm) - Jet::constant(radius * radius)) * (0.5 / radius));
                if let Rider::Pin { block: Some(block), .. } = slide.rider {
                    let start = minus(mechanism.at(point), centre);
                    all.push(state.turn(block) - arm.turned_from(start));
                }
            }
        }
    }
    for roll in &mechanism.rolls {
        let [a, b] = roll.bodies;
        match roll.contact {
            Contact::Wheels { centres: [p, q], radii: [r, s], internal } => {
                let (from, to) = (mechanism.at(p), mechanism.at(q));
                let arm = state.place(b, to).minus(state.place(a, from));
                let line = arm.turned_from(minus(to, from));
                let sense = if internal { -1.0 } else { 1.0 };
                all.push((state.turn(a) - line) * r + (state.turn(b) - line) * (sense * s));
                if roll.keeps_distance {
                    let apart = if internal { (r - s).abs() } else { r + s };
                    all.push((arm.dot(arm) - Jet::constant(apart * apart)) * (0.5 / apart));
                }
            }
            Contact::Rack { through, along, centre, radius } => {
                let place = mechanism.at(centre);
                let arm = state.place(b, place).minus(state.place(a, through));
                let side = if dot(left(along), minus(place, through)) > 0.0 { 1.0 } else { -1.0 };
                let run =
                    state.direction(a, along).dot(arm) - Jet::constant(dot(along, minus(place, through)));
                all.push(run + (state.turn(b) - state.turn(a)) * (side * radius));
                if roll.keeps_distance {
                    all.push(state.direction(a, left(along)).dot(arm) - Jet::constant(side * radius));
                }
            }
        }
    }
    all
}

/// What the inputs say, so long after the instant.
fn drives(mechanism: &Mechanism, state: &State, after: f64) -> Vec<Jet> {
    let driven = |rate: f64, second: f64| {
        Jet::new(rate * after + 0.5 * second * after * after, rate + second * after, second)
    };
    mechanism
        .inputs
        .iter()
        .map(|input| match input.driver {
            Driver::Link(body) => state.turn(body) - driven(input.rate, input.second),
            Driver::Slide(slide) => {
                let slide = &mechanism.slides[slide];
                let Path::Line { through, along } = slide.path else { unreachable!("no arc is driven") };
                let (point, body) = mechanism.rider(slide);
                let place = mechanism.at(point);
                let arm = state.place(body, place).minus(state.place(slide.on, through));
                let start = dot(along, minus(place, through));
                state.direction(slide.on, along).dot(arm)
                    - Jet::constant(start)
                    - driven(input.rate, input.second)
            }
        })
        .collect()
}

/// What a scene says of places.
pub(crate) struct Told {
    /// By point: its place.
    pub(crate) stands: Vec<bool>,
    /// By slide: its rider is a link that rides as placed, with no angle said between the two.
    pub(crate) as_placed: Vec<bool>,
    /// By input: its angle, or its place along the guide.
    pub(crate) inputs: Vec<bool>,
    /// By body: its joints in the order in which they are said; the first one of a link that rides lies on the guide.
    pub(crate) joins: Vec<Vec<usize>>,
    /// By body: its axes are the world's, whatever else is said.
    pub(crate) upright: Vec<bool>,
}

/// Of how many points the places may still change, to first order, by what a scene says: lengths and guides, and what is told of
/// places; rolling says nothing. `angles`: whether it is said how links that ride as placed are turned against their guides.
fn loose_points(mechanism: &Mechanism, told: &Told, angles: bool) -> usize {
    /// Singular values below this part of the largest are zero.
    const ZERO: f64 = 1e-9;
    /// A coordinate that changes by less than this part of what changes at all stands.
    const STANDS: f64 = 1e-6;
    let mut as_said = mechanism.clone();
    for (body, joins) in as_said.bodies.iter_mut().zip(&told.joins) {
        body.joins.clone_from(joins);
    }
    let mechanism = &as_said;
    let mut state = start(mechanism);
    let unknowns = state.jets.len();
    let size = mechanism.size();
    let all = |state: &State| {
        let mut all = Vec::new();
        let without_rolls = Mechanism { rolls: Vec::new(), ..mechanism.clone() };
        let riding = told.as_placed.iter().zip(&mechanism.slides);
        let mut loose: Vec<[usize; 2]> = Vec::new();
        for (_, slide) in riding.filter(|(as_placed, _)| **as_placed && !angles) {
            if let Rider::Link(rider) = slide.rider {
                loose.push([rider, slide.on]);
            }
        }
        all.extend(equations_but(&without_rolls, state, &loose));
        for roll in mechanism.rolls.iter().filter(|roll| roll.keeps_distance) {
            let only = Mechanism { rolls: vec![*roll], slides: vec![], ..mechanism.clone() };
            all.extend(equations(&only, state).pop());
        }
        for (drive, _) in
            drives(mechanism, state, 0.0).into_iter().zip(&told.inputs).filter(|(_, told)| **told)
        {
            all.push(drive);
        }
        for (point, _) in mechanism.points.iter().zip(&told.stands).filter(|(_, stands)| **stands) {
            let at = state.place(point.of[0], point.at);
            all.extend([at.x, at.y]);
        }
        for body in (1..mechanism.bodies.len()).filter(|body| told.upright[*body]) {
            all.push(state.turn(body));
        }
        all
    };
    // What an input does at rest is no coefficient.
    let rest: Vec<f64> = all(&state).iter().map(|equation| equation.rate).collect();
    let mut columns = DMatrix::zeros(rest.len().max(unknowns), unknowns);
    for column in 0..unknowns {
        state.jets[column].rate = if column % 3 == 2 { 1.0 } else { size };
        for (row, (equation, rest)) in all(&state).iter().zip(&rest).enumerate() {
            columns[(row, column)] = (equation.rate - rest) / size.max(f64::MIN_POSITIVE);
        }
        state.jets[column].rate = 0.0;
    }
    let decomposed = columns.svd(false, true);
    let Some(right) = decomposed.v_t else { return 0 };
    let largest = decomposed.singular_values.max();
    let free: Vec<usize> =
        (0..unknowns).filter(|k| decomposed.singular_values[*k] <= ZERO * largest).collect();
    let mut moves = vec![false; mechanism.points.len()];
    for k in free {
        for (column, jet) in state.jets.iter_mut().enumerate() {
            jet.rate = right[(k, column)] * if column % 3 == 2 { 1.0 } else { size };
        }
        for (point, moves) in mechanism.points.iter().zip(&mut moves) {
            *moves |= length(state.place(point.of[0], point.at).velocity()) > STANDS * size;
        }
        state.jets.iter_mut().for_each(|jet| jet.rate = 0.0);
    }
    moves.into_iter().filter(|moves| *moves).count()
}

/// Whether a scene tells the places in spite of links that ride as placed: what these leave open, nothing else may have to say.
pub(crate) fn tells_places(mechanism: &Mechanism, told: &Told) -> bool {
    !told.as_placed.contains(&true)
        || loose_points(mechanism, told, false) <= loose_points(mechanism, told, true)
}

/// Why there is no truth.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum NoTruth {
    /// Equations and unknowns.
    Mobility { equations: usize, unknowns: usize },
    /// The places do not satisfy the constraints.
    Open(f64),
    /// At or next to a dead centre.
    Singular(f64),
}

/// Reciprocal condition below which a mechanism is taken as next to a dead centre.
pub(crate) const SINGULAR: f64 = 5e-4;

struct Linear {
    columns: DMatrix<f64>,
    size: f64,
}

/// Positions as they stand in `state`; rates are probed one by one.
fn jacobian(mechanism: &Mechanism, state: &mut State, after: f64) -> Linear {
    let size = mechanism.size();
    let unknowns = state.jets.len();
    let all = |state: &State| {
        let mut all = equations(mechanism, state);
        all.extend(drives(mechanism, state, after));
        all
    };
    for jet in &mut state.jets {
        (jet.rate, jet.second) = (0.0, 0.0);
    }
    let rest: Vec<f64> = all(state).iter().map(|e| e.rate).collect();
    let mut columns = DMatrix::zeros(rest.len(), unknowns);
    for column in 0..unknowns {
        let unit = if column % 3 == 2 { 1.0 } else { size };
        state.jets[column].rate = unit;
        for (row, (equation, rest)) in all(state).iter().zip(&rest).enumerate() {
            columns[(row, column)] = equation.rate - rest;
        }
        state.jets[column].rate = 0.0;
    }
    Linear { columns, size }
}

fn solve_linear(linear: &Linear, rights: &[f64]) -> Option<Vec<f64>> {
    let solution = linear.columns.clone().lu().solve(&DVector::from_column_slice(rights))?;
    let unit = |column: usize| if column % 3 == 2 { 1.0 } else { linear.size };
    Some(solution.iter().enumerate().map(|(c, x)| x * unit(c)).collect())
}

fn start(mechanism: &Mechanism) -> State {
    let pivots = (0..mechanism.bodies.len())
        .map(|body| mechanism.points.iter().find(|p| p.of.contains(&body)).map_or([0.0, 0.0], |p| p.at))
        .collect();
    State { jets: vec![Jet::default(); 3 * (mechanism.bodies.len() - 1)], pivots, condition: 1.0 }
}

/// Rates at positions that hold.
fn rates(mechanism: &Mechanism, state: &mut State, after: f64) -> Result<(), NoTruth> {
    let linear = jacobian(mechanism, state, after);
    let (rows, unknowns) = linear.columns.shape();
    if rows != unknowns {
        return Err(NoTruth::Mobility { equations: rows, unknowns });
    }
    // Rows to one size: lengths and angles alike.
    let mut scaled = linear.columns.clone();
    for mut row in scaled.row_iter_mut() {
        let norm = row.norm();
        if norm == 0.0 {
            return Err(NoTruth::Singular(0.0));
        }
        row /= norm;
    }
    let values = scaled.singular_values();
    state.condition = values.min() / values.max();
    if state.condition < SINGULAR {
        return Err(NoTruth::Singular(state.condition));
    }
    let all = |state: &State| {
        let mut all = equations(mechanism, state);
        all.extend(drives(mechanism, state, after));
        all
    };
    let rights: Vec<f64> = all(state).iter().map(|e| -e.rate).collect();
    let solution = solve_linear(&linear, &rights).ok_or(NoTruth::Singular(0.0))?;
    for (jet, rate) in state.jets.iter_mut().zip(&solution) {
        jet.rate = *rate;
    }
    let rights: Vec<f64> = all(state).iter().map(|e| -e.second).collect();
    let solution = solve_linear(&linear, &rights).ok_or(NoTruth::Singular(0.0))?;
    for (jet, second) in state.jets.iter_mut().zip(&solution) {
        jet.second = *second;
    }
    Ok(())
}

/// The motion at the instant of the places.
pub(crate) fn solve(mechanism: &Mechanism) -> Result<State, NoTruth> {
    let mut state = start(mechanism);
    let open = equations(mechanism, &state).iter().fold(0.0_f64, |worst, e| worst.max(e.value.abs()));
    if open > 1e-12 * (mechanism.size() + mechanism.points.iter().fold(0.0, |s: f64, p| s.max(length(p.at))))
    {
        return Err(NoTruth::Open(open));
    }
    rates(mechanism, &mut state, 0.0)?;
    Ok(state)
}

/// The positions a while later, found anew by Newton's method.
pub(crate) fn later(mechanism: &Mechanism, after: f64) -> Option<State> {
    let mut state = start(mechanism);
    for _ in 0..30 {
        let mut all = equations(mechanism, &state);
        all.extend(drives(mechanism, &state, after));
        let rights: Vec<f64> = all.iter().map(|e| -e.value).collect();
        let linear = jacobian(mechanism, &mut state, after);
        let step = solve_linear(&linear, &rights)?;
        for (jet, step) in state.jets.iter_mut().zip(&step) {
            jet.value += step;
        }
    }
    Some(state)
}
