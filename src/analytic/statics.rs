//! Reactions and efforts: the multipliers of the pair constraints, for all links at once.
//!
//! By d'Alembert and Lagrange, for a unit virtual rate of each coordinate of each body: the work of the multipliers in
//! the pair equations, of the sought efforts, of loads, weights and springs, less that of M A and I ε, is zero.
//! Virtual rates are the `d` of the same jets of which the equations are made, so that there is no second
//! formula of any pair, and no free body, arm or group. Each balance is recorded, and its sensitivities to
//! multipliers, poses, rates, accelerations and given numbers come from the record.

use std::collections::HashMap;

use super::AnalyticError;
use super::constraints::{Drive, Formulas, Motion, Num, Row, Scope, Site, Straight};
use super::friction::{Rubbing, Strength};
use super::linear::System;
use super::model::{Model, Tie, Track};
use super::motion::{Located, Solved};
use super::ordering::{Ordering, order};
use super::tape::{Calculus, Jet, Leaf, Linear, Tape, U, Var, dot, minus};
use crate::mechanism::curve::Curve;
use crate::mechanism::force::{
    Area, Heaviness, Inertia, LoadKind, Pointing, Pressure, Share, Size, Sought, SpringKind, SpringLaw,
    Unaimed,
};
use crate::mechanism::quantity::Indeterminate;
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Roll};

/// Rounds of iterative refinement.
const REFINEMENTS: usize = 3;

/// What acts on the bodies, in the scaled numbers of a model. Forces are counted in kg·length/time², so that masses stay
/// kilograms.
#[derive(Debug, Clone, Default)]
pub(super) struct Burden {
    /// g and its direction, where weights act.
    gravity: Option<[Num; 2]>,
    pub(super) masses: Vec<HeavyBody>,
    pub(super) loads: Vec<BodyLoad>,
    /// Sizes of loads over the angle of the first input.
    curves: Vec<BodyCurve>,
    turned: Option<InputAngle>,
    pub(super) springs: Vec<BodySpring>,
    /// The axis of a governor.
    spin: Option<BodySpin>,
    /// The sleeve of a governor on its guide, where something rubs: its sliding says in which senses.
    pub(super) sleeve: Option<(Site, Straight)>,
    /// The equations of the pairs, without those of inputs.
    pub(super) pairs: Vec<(Row, Tie)>,
    /// Of which pair equations teeth lean, by their place among the pairs.
    meshes: Vec<(usize, Mesh)>,
    /// The multipliers of rolling pairs that keep their own contact, which have to push: their place among the pairs, the
    /// sign with which they push, and the pair.
    pub(super) contacts: Vec<(usize, f64, usize)>,
    /// What is sought, in the order of the unknowns after the pairs.
    pub(super) sought: Vec<Sought>,
    /// The pairs that rub.
    pub(super) rubbing: Vec<Rubbing>,
    /// Why something that acts has no direction here: what hangs on it is not told.
    pub(super) unaimed: Option<Indeterminate>,
}

/// Teeth whose distance others hold: they push the wheels apart, tan φ times as hard as they drive.
#[derive(Debug, Clone)]
struct Mesh {
    /// The distance of the wheels, which grows where they go apart with the sign.
    distance: Row,
    sign: f64,
    /// φ.
    pressure: Num,
}

/// A mass.
#[derive(Debug, Clone, Copy)]
pub(super) struct HeavyBody {
    pub(super) link: LinkId,
    /// Where its mass centre is.
    pub(super) centre: Site,
    heaviness: Heavy,
    inertia: Turning,
}

#[derive(Debug, Clone, Copy)]
enum Heavy {
    Mass(Num),
    /// Weight and g.
    Weight([Num; 2]),
    None,
}

#[derive(Debug, Clone, Copy)]
enum Turning {
    Point,
    Central(Num),
    /// About this place of the body.
    About([Num; 2], Num),
    Gyration(Num),
}

/// A load.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodyLoad {
    pub(super) body: usize,
    /// Where a force acts; none for a torque.
    pub(super) at: Option<Site>,
    size: LoadSize,
    pointing: Toward,
    /// It has no direction here.
    pub(super) unaimed: bool,
}

#[derive(Debug, Clone, Copy)]
enum LoadSize {
    One(Level),
    Pair([Num; 2]),
    Pressure(Level, [Num; 2]),
    PressureOn(Level, Num),
    Sought(usize),
}

/// A number, or a curve of [`Burden::curves`].
#[derive(Debug, Clone, Copy)]
enum Level {
    One(Num),
    Curve(usize),
}

/// A size over the angle of the first input.
#[derive(Debug, Clone)]
enum BodyCurve {
    /// Angles as they decide which piece counts, then angles and sizes.
    Table {
        angles: Vec<f64>,
        knots: Vec<[Num; 2]>,
        turn: f64,
        period: Num,
    },
    Harmonics {
        constant: Num,
        waves: Vec<BodyWave>,
    },
}

#[derive(Debug, Clone, Copy)]
struct BodyWave {
    order: Num,
    size: Num,
    sine: bool,
}

/// How the angle of the first input is known.
#[derive(Debug, Clone, Copy)]
enum InputAngle {
    Given(Num),
    /// The direction from one place to another, within a turn from +x.
    Line([Site; 2]),
}

/// Nearer than this part of the period to a knot one stands on it.
const ON_KNOT: f64 = 16.0 * U;

#[derive(Debug, Clone, Copy)]
enum Toward {
    World(Num),
    /// Components or an angle in a body.
    Own(usize, Num),
    Between([Site; 2], Num),
    /// With the motion: +1, against it: −1.
    Motion(f64),
}

/// A spring.
#[derive(Debug, Clone, Copy)]
pub(super) struct BodySpring {
    between: Between,
    law: BodyLaw,
    /// Within half a turn of which angle a torsion spring is turned.
    wound: f64,
    /// It has no direction here.
    pub(super) unaimed: bool,
}

/// Between what a spring acts: two places, or two bodies that turn against each other.
#[derive(Debug, Clone, Copy)]
enum Between {
    Places([Site; 2]),
    Bodies([usize; 2]),
}

impl BodySpring {
    fn bodies(&self) -> [usize; 2] {
        match self.between {
            Between::Places(ends) => ends.map(|end| end.body),
            Between::Bodies(bodies) => bodies,
        }
    }
}

#[derive(Debug, Clone, Copy)]
enum BodyLaw {
    Stiffness(Num, Num),
    StiffnessSought(usize, Num),
    Force(Num),
    ForceSought(usize),
}

/// A plane that turns about an axis in it.
#[derive(Debug, Clone, Copy)]
struct BodySpin {
    through: [Num; 2],
    angle: Num,
    /// Given, or the place of ω² among what is sought.
    omega: Result<Num, usize>,
    /// Where the sleeve rides, along which line, and the drag against it.
    drag: Option<(Site, Straight, Num)>,
}

/// Balance of one share of what acts.
#[derive(Debug, Clone)]
pub(super) struct Balance {
    /// Multipliers of the pairs, then what is sought.
    pub(super) x: Vec<f64>,
    /// The equations of balance at the solution.
    pub(super) rows: Vec<Linear>,
    /// Their matrix.
    pub(super) system: System,
    /// Unknowns that balance does not fix.
    pub(super) undetermined: Vec<bool>,
    /// Bodies that are out of balance, since what is sought does no work: whichever of them is left out, what hangs on the
    /// others comes out differently.
    pub(super) unbalanced: Vec<usize>,
    /// How pairs rub.
    pub(super) strength: Strength,
}

/// A scope in which one coordinate has a unit virtual rate.
pub(super) struct Virtual<'t> {
    tape: &'t Tape,
    motion: Motion<'t>,
    column: usize,
}

impl<'t> Formulas for Virtual<'t> {
    type Number = Jet<'t>;

    fn num(&self, num: Num) -> Jet<'t> {
        self.tape.steady(match num {
            Num::Exact(value) => self.tape.constant(value),
            Num::Param(index) => self.tape.leaf(Leaf::Param(index), self.motion.params[index].value),
        })
    }

    fn exact(&self, value: f64) -> Jet<'t> {
        self.tape.number(value)
    }

    fn coordinate(&self, body: usize, axis: usize) -> Jet<'t> {
        if body == 0 {
            return self.tape.number(0.0);
        }
        let at = 3 * body + axis;
        Jet {
            v: self.tape.leaf(Leaf::Pose(at), self.motion.pose[at]),
            d: self.tape.constant(if at == self.column { 1.0 } else { 0.0 }),
            a: self.tape.constant(0.0),
        }
    }

    fn drive(&self, drive: &Drive) -> Jet<'t> {
        self.num(drive.value)
    }
}

/// Formulas over the motion and the multipliers.
pub(super) struct Acting<'t> {
    pub(super) real: Scope<'t>,
    pub(super) burden: &'t Burden,
    pub(super) model: &'t Model,
    x: &'t [f64],
    share: Share,
    /// Whether accelerations are known.
    moves: bool,
    /// How pairs rub.
    pub(super) strength: &'t Strength,
}

impl<'t> Acting<'t> {
    pub(super) fn new(
        real: Scope<'t>,
        (model, burden): (&'t Model, &'t Burden),
        (x, strength): (&'t [f64], &'t Strength),
        share: Share,
        moves: bool,
    ) -> Self {
        Self { real, burden, model, x, share, moves, strength }
    }

    fn tape(&self) -> &'t Tape {
        self.real.tape
    }

    /// A multiplier, or what is sought.
    pub(super) fn unknown(&self, index: usize) -> Var<'t> {
        self.tape().leaf(Leaf::Force(index), self.x[index])
    }

    /// The unknown that stands for what is sought, by its place in [`Burden::sought`].
    pub(super) fn effort(&self, index: usize) -> Var<'t> {
        self.unknown(self.burden.pairs.len() + index)
    }

    pub(super) fn virtually(&self, column: usize) -> Virtual<'t> {
        Virtual { tape: self.tape(), motion: self.real.motion, column }
    }

    /// The generalised force of a pair equation of the burden, for a unit multiplier, on a coordinate; with what teeth
    /// push apart.
    fn slope_of(&self, index: usize, column: usize) -> Var<'t> {
        let slope = self.slope(&self.burden.pairs[index].0, column);
        let Some((place, mesh)) = self
            .burden
            .meshes
            .iter()
            .enumerate()
            .find_map(|(place, (of, mesh))| (*of == index).then_some((place, mesh)))
        else {
            return slope;
        };
        match self.strength.meshes.get(place) {
            Some(sense) if mesh.distance.hangs_on(column / 3) => {
                // With friction teeth may drive by the other flank than without.
                let own = if self.x[index] < 0.0 { -1.0 } else { 1.0 };
                let sense = if *sense == 0.0 { own } else { *sense };
                let [cos, sin] = self.real.num(mesh.pressure).v.cos_sin();
                let apart = self.virtually(column).row(&mesh.distance).d;
                slope + sin / cos * self.tape().constant(sense * mesh.sign) * apart
            }
            _ => slope,
        }
    }

    /// The generalised force of a pair equation, for a unit multiplier, on a coordinate.
    pub(super) fn slope(&self, row: &Row, column: usize) -> Var<'t> {
        if row.hangs_on(column / 3) { self.virtually(column).row(row).d } else { self.tape().constant(0.0) }
    }

    /// The force that chosen pair equations exert on a body, and its moment about a place.
    pub(super) fn wrench(
        &self,
        chosen: impl Fn(&Row, Tie) -> bool,
        body: usize,
        about: [Var<'t>; 2],
    ) -> [Var<'t>; 3] {
        let zero = self.tape().constant(0.0);
        let mut sum = [zero; 3];
        for (index, (row, tie)) in self.burden.pairs.iter().enumerate() {
            if !chosen(row, *tie) || !row.hangs_on(body) {
                continue;
            }
            let size = self.unknown(index);
            for (axis, part) in sum.iter_mut().enumerate() {
                *part = *part + self.slope_of(index, 3 * body + axis) * size;
            }
        }
        let [x, y, turning] = sum;
        let origin = self.real.origin(body).map(|c| c.v);
        let arm = [origin[0] - about[0], origin[1] - about[1]];
        [x, y, turning + (arm[0] * y - arm[1] * x)]
    }

    /// The mass of a body.
    fn mass(&self, heavy: &HeavyBody) -> Var<'t> {
        match heavy.heaviness {
            Heavy::Mass(mass) => self.real.num(mass).v,
            Heavy::Weight([weight, g]) => self.real.num(weight).v / self.real.num(g).v,
            Heavy::None => self.tape().constant(0.0),
        }
    }

    /// The moment of inertia of a body about its mass centre.
    fn inertia(&self, heavy: &HeavyBody) -> Var<'t> {
        match heavy.inertia {
            Turning::Point => self.tape().constant(0.0),
            Turning::Central(inertia) => self.real.num(inertia).v,
            Turning::Gyration(radius) => {
                let radius = self.real.num(radius).v;
                self.mass(heavy) * (radius * radius)
            }
            Turning::About(place, inertia) => {
                let away = minus(self.real.pair(place), self.real.pair(heavy.centre.own));
                self.real.num(inertia).v - self.mass(heavy) * dot(away, away).v
            }
        }
    }

    /// −M A_G and −I ε of a body.
    pub(super) fn inertial(&self, heavy: &HeavyBody) -> ([Var<'t>; 2], Var<'t>) {
        let mass = -self.mass(heavy);
        let acceleration = self.real.site(&heavy.centre).map(|jet| jet.a);
        let turning = -(self.inertia(heavy) * self.real.angle(heavy.centre.body).a);
        (acceleration.map(|a| a * mass), turning)
    }

    pub(super) fn weight(&self, heavy: &HeavyBody) -> Option<[Var<'t>; 2]> {
        let [g, direction] = self.burden.gravity?;
        let weight = match heavy.heaviness {
            Heavy::Weight([weight, _]) => self.real.num(weight).v,
            _ => self.mass(heavy) * self.real.num(g).v,
        };
        let along = self.real.num(direction).cos_sin();
        Some(along.map(|c| c.v * weight))
    }

    /// The force of a load, or its torque in the first place of the three: x, y, torque.
    pub(super) fn load(&self, load: &BodyLoad) -> [Var<'t>; 3] {
        let zero = self.tape().constant(0.0);
        if load.unaimed {
            // Whatever is read off it is no number.
            return [self.tape().constant(1.0) / zero; 3];
        }
        let s = &self.real;
        let size = match load.size {
            LoadSize::One(size) => self.level(size),
            LoadSize::Sought(index) => self.effort(index),
            LoadSize::PressureOn(pressure, area) => self.level(pressure) * s.num(area).v,
            LoadSize::Pressure(pressure, [bore, rod]) => {
                let (bore, rod) = (s.num(bore).v, s.num(rod).v);
                let quarter_pi = s.tape.rounded(std::f64::consts::FRAC_PI_4, U);
                self.level(pressure) * quarter_pi * (bore * bore - rod * rod)
            }
            LoadSize::Pair([x, y]) => {
                let parts = [s.num(x), s.num(y)];
                let Toward::Own(body, _) = load.pointing else { return [parts[0].v, parts[1].v, zero] };
                let turned = super::tape::turned(parts, s.angle(body));
                return [turned[0].v, turned[1].v, zero];
            }
        };
        let Some(at) = &load.at else {
            let torque = match load.pointing {
                Toward::Motion(sign) => {
                    let omega = s.angle(load.body).d;
                    let sense = if omega.value < 0.0 { -sign } else { sign };
                    size * s.tape.constant(sense)
                }
                _ => size,
            };
            return [zero, zero, torque];
        };
        let direction = match load.pointing {
            Toward::World(angle) => s.num(angle).cos_sin().map(|c| c.v),
            Toward::Own(body, angle) => (s.angle(body) + s.num(angle)).cos_sin().map(|c| c.v),
            Toward::Between([from, to], turned) => {
                let along = minus(s.site(&to), s.site(&from));
                let length = dot(along, along).sqrt();
                let unit = [along[0] / length, along[1] / length];
                super::tape::turned(unit, s.num(turned)).map(|c| c.v)
            }
            Toward::Motion(sign) => {
                let velocity = s.site(at).map(|c| c.d);
                let speed = (velocity[0] * velocity[0] + velocity[1] * velocity[1]).sqrt();
                velocity.map(|c| c / speed * s.tape.constant(sign))
            }
        };
        [direction[0] * size, direction[1] * size, zero]
    }

    /// A number, or the height of a curve at the angle of the first input.
    fn level(&self, level: Level) -> Var<'t> {
        match level {
            Level::One(num) => self.real.num(num).v,
            Level::Curve(curve) => match (self.burden.curves.get(curve), self.burden.turned) {
                (Some(curve), Some(turned)) => self.height(curve, self.turned(turned)),
                // Refused where the model is made.
                _ => self.tape().constant(1.0) / self.tape().constant(0.0),
            },
        }
    }

    /// The angle of the first input, radians.
    fn turned(&self, turned: InputAngle) -> Var<'t> {
        match turned {
            InputAngle::Given(angle) => self.real.num(angle).v,
            InputAngle::Line([from, to]) => {
                let along = minus(self.real.site(&to), self.real.site(&from));
                let angle = along[1].v.atan2(along[0].v);
                if angle.value >= 0.0 {
                    return angle;
                }
                let turn = std::f64::consts::TAU;
                angle + self.tape().rounded(turn, 2.0 * U * turn)
            }
        }
    }

    /// The height of a curve: where it leaps, that behind the leap.
    fn height(&self, curve: &BodyCurve, at: Var<'t>) -> Var<'t> {
        let num = |num: Num| self.real.num(num).v;
        match curve {
            BodyCurve::Harmonics { constant, waves } => waves.iter().fold(num(*constant), |sum, wave| {
                let angle = self.tape().steady(num(wave.order) * at);
                let [cos, sin] = angle.cos_sin().map(|c| c.v);
                sum + num(wave.size) * if wave.sine { sin } else { cos }
            }),
            BodyCurve::Table { angles, knots, turn, period } => {
                let room = ON_KNOT * turn;
                let whole = libm::floor((at.value - angles[0] + room) / turn);
                let place = at.value - whole * turn;
                // The last knot that is not ahead.
                let from = angles.partition_point(|angle| *angle <= place + room).max(1) - 1;
                let mut here = at;
                if whole != 0.0 {
                    here = here - self.tape().constant(whole) * num(*period);
                }
                let [start, low] = knots[from].map(num);
                if (angles[from] - place).abs() <= room {
                    return low;
                }
                let [end, high] = match knots.get(from + 1) {
                    Some(next) => next.map(num),
                    None => [num(knots[0][0]) + num(*period), num(knots[0][1])],
                };
                low + (high - low) * ((here - start) / (end - start))
            }
        }
    }

    /// How much longer a spring is than free, or how much further its second body is turned against the first.
    fn longer(&self, spring: &BodySpring, now: Var<'t>, free: Num) -> Var<'t> {
        let more = now - self.real.num(free).v;
        match spring.between {
            Between::Places(_) => more,
            Between::Bodies(_) => more.wrapped_about(spring.wound),
        }
    }

    /// The pull of a spring, given its length; of a torsion spring its torque on the first body, given the angle.
    fn pull_of(&self, spring: &BodySpring, now: Var<'t>) -> Var<'t> {
        let stated = |force: Var<'t>| match spring.between {
            Between::Places(_) => force,
            // It is told as the torque on the second body.
            Between::Bodies(_) => -force,
        };
        match spring.law {
            BodyLaw::Stiffness(stiffness, free) => {
                self.real.num(stiffness).v * self.longer(spring, now, free)
            }
            BodyLaw::StiffnessSought(index, free) => self.effort(index) * self.longer(spring, now, free),
            BodyLaw::Force(force) => stated(self.real.num(force).v),
            BodyLaw::ForceSought(index) => stated(self.effort(index)),
        }
    }

    /// The length of a spring, or the angle of its second body against the first.
    fn length<S: Formulas>(scope: &S, spring: &BodySpring) -> S::Number {
        match &spring.between {
            Between::Places([first, second]) => {
                let along = minus(scope.site(second), scope.site(first));
                dot(along, along).sqrt()
            }
            Between::Bodies([first, second]) => scope.angle(*second) - scope.angle(*first),
        }
    }

    /// A spring on what all halves of a governor share is shared too.
    fn part_of_spring(&self, spring: &BodySpring) -> Var<'t> {
        let bodies = spring.bodies();
        let shared = |body: &&usize| self.model.mechanism.shared_by(LinkId(**body)) != 1.0;
        self.part(*bodies.iter().find(shared).unwrap_or(&bodies[0]))
    }

    /// The pull of a spring; of a torsion spring its torque on the first body.
    pub(super) fn pull(&self, spring: &BodySpring) -> Var<'t> {
        self.pull_of(spring, Self::length(&self.real, spring).v)
    }

    /// The pull of a spring on one of its ends, and where that is.
    pub(super) fn spring_on(&self, spring: &BodySpring, end: usize) -> ([Var<'t>; 2], [Var<'t>; 2]) {
        let Between::Places(ends) = &spring.between else {
            // A torque has no line.
            return ([self.tape().constant(0.0); 2], [self.tape().constant(0.0); 2]);
        };
        let (own, other) = (self.real.site(&ends[end]), self.real.site(&ends[1 - end]));
        if spring.unaimed {
            return ([self.tape().constant(1.0) / self.tape().constant(0.0); 2], own.map(|c| c.v));
        }
        let (length, pull) = (Self::length(&self.real, spring).v, self.pull(spring));
        let along = minus(other, own);
        (along.map(|c| c.v / length * pull), own.map(|c| c.v))
    }

    /// The part of what acts on a body that counts in the half of a governor that is drawn.
    fn part(&self, body: usize) -> Var<'t> {
        let shared = self.model.mechanism.shared_by(LinkId(body));
        self.tape().constant(1.0) / self.tape().constant(shared)
    }

    /// M r of a mass, away from the axis of a governor: its force at unit ω².
    fn away(&self, spin: &BodySpin, heavy: &HeavyBody) -> [Var<'t>; 2] {
        let [cos, sin] = self.real.num(spin.angle).cos_sin().map(|c| c.v);
        let out = minus(self.real.site(&heavy.centre), self.real.pair(spin.through)).map(|c| c.v);
        // What of the way out is along the axis is taken off.
        let along = out[0] * cos + out[1] * sin;
        let mass = self.mass(heavy);
        [(out[0] - cos * along) * mass, (out[1] - sin * along) * mass]
    }

    /// ω² of a governor.
    fn spin_squared(&self, spin: &BodySpin) -> Var<'t> {
        match spin.omega {
            Ok(omega) => {
                let omega = self.real.num(omega).v;
                omega * omega
            }
            Err(index) => self.effort(index),
        }
    }

    /// M ω² r of a mass; nothing where the plane does not turn.
    pub(super) fn centrifugal(&self, heavy: &HeavyBody) -> [Var<'t>; 2] {
        match &self.burden.spin {
            Some(spin) => {
                let square = self.spin_squared(spin);
                self.away(spin, heavy).map(|c| c * square)
            }
            None => [self.tape().constant(0.0); 2],
        }
    }

    /// The drag of the sleeve as it counts in one half, along its guide.
    fn drag(&self, spin: &BodySpin) -> Option<(Row, Var<'t>)> {
        let (site, line, size) = spin.drag?;
        let told = self.model.mechanism.forces.spin?;
        let sense = told.sense(self.share, &self.model.mechanism)?;
        let zero = Num::Exact(0.0);
        let row = Row::Push(site, line, Drive { value: zero, rate: zero, arm: None, second: zero });
        let size = self.real.num(size).v * self.part(told.sleeve?.0);
        Some((row, size * self.tape().constant(-sense)))
    }

    /// The whole drag on the sleeve, and where it acts.
    pub(super) fn drag_on_sleeve(&self) -> Option<([Var<'t>; 2], [Var<'t>; 2])> {
        let (site, line, size) = self.burden.spin.as_ref()?.drag?;
        let told = self.model.mechanism.forces.spin?;
        let sense = told.sense(self.share, &self.model.mechanism)?;
        let size = self.real.num(size).v * self.tape().constant(-sense);
        let force = self.real.direction(&line).map(|c| c.v * size);
        Some((force, self.real.site(&site).map(|c| c.v)))
    }

    fn statical(&self) -> bool {
        self.share != Share::Inertia
    }

    pub(super) fn inertial_too(&self) -> bool {
        self.share != Share::Static && self.moves && !self.model.mechanism.rests_in_its_plane()
    }

    /// The balance on one coordinate, with the terms that hang on each unknown.
    fn balance(&self, column: usize) -> (Var<'t>, Vec<(usize, Var<'t>)>) {
        let (body, axis) = (column / 3, column % 3);
        let zero = self.tape().constant(0.0);
        let virtually = self.virtually(column);
        let mut slopes = Vec::new();
        for (index, (row, _)) in self.burden.pairs.iter().enumerate() {
            if row.hangs_on(body) {
                slopes.push((index, self.slope_of(index, column)));
            }
        }
        let work = |force: [Var<'t>; 2], site: &Site| {
            let moved = virtually.site(site).map(|c| c.d);
            force[0] * moved[0] + force[1] * moved[1]
        };
        let turned = virtually.angle(body).d;
        let pairs = self.burden.pairs.len();
        for (index, sought) in self.burden.sought.iter().enumerate() {
            let Sought::Effort(input) = *sought else { continue };
            let slope = match self.model.effort_row(input) {
                Some(row) if row.hangs_on(body) => virtually.row(&row).d,
                _ => continue,
            };
            slopes.push((pairs + index, slope));
        }
        let mut sum = zero;
        // What is sought is a load for a unit of it: it stands among the unknowns, not in the sum.
        for load in self.burden.loads.iter().filter(|load| load.body == body && !load.unaimed) {
            let unit = |index: usize| {
                let alone = BodyLoad { size: LoadSize::One(Level::One(Num::Exact(1.0))), ..*load };
                (pairs + index, alone)
            };
            let of = |load: &BodyLoad| {
                let [x, y, torque] = self.load(load);
                match &load.at {
                    Some(at) => work([x, y], at),
                    None => torque * turned,
                }
            };
            match load.size {
                LoadSize::Sought(index) => {
                    let (index, alone) = unit(index);
                    slopes.push((index, of(&alone) * self.part(body)));
                }
                _ if self.statical() => sum = sum + of(load) * self.part(body),
                _ => {}
            }
        }
        for spring in &self.burden.springs {
            if spring.unaimed || !spring.bodies().contains(&body) {
                continue;
            }
            let length = Self::length(&virtually, spring);
            let stretch = -(length.d * self.part_of_spring(spring));
            match spring.law {
                BodyLaw::StiffnessSought(index, free) => {
                    slopes.push((pairs + index, stretch * self.longer(spring, length.v, free)));
                }
                BodyLaw::ForceSought(index) => {
                    let sense = match spring.between {
                        Between::Places(_) => stretch,
                        Between::Bodies(_) => -stretch,
                    };
                    slopes.push((pairs + index, sense));
                }
                _ if self.statical() => sum = sum + stretch * self.pull_of(spring, length.v),
                _ => {}
            }
        }
        for heavy in self.burden.masses.iter().filter(|heavy| heavy.centre.body == body) {
            if self.statical()
                && let Some(weight) = self.weight(heavy)
            {
                sum = sum + work(weight, &heavy.centre) * self.part(body);
            }
            if self.inertial_too() {
                let (force, couple) = self.inertial(heavy);
                sum = sum + work(force, &heavy.centre) * self.part(body);
                if axis == 2 {
                    sum = sum + couple * self.part(body);
                }
            }
            if let Some(spin) = &self.burden.spin {
                let away = work(self.away(spin, heavy), &heavy.centre) * self.part(body);
                match spin.omega {
                    Err(index) => slopes.push((pairs + index, away)),
                    Ok(_) if self.share != Share::Static => sum = sum + away * self.spin_squared(spin),
                    Ok(_) => {}
                }
            }
        }
        if let (Some(spin), true) = (&self.burden.spin, self.statical())
            && let Some((row, size)) = self.drag(spin)
            && row.hangs_on(body)
        {
            sum = sum + virtually.row(&row).d * size;
        }
        for (index, slope) in &slopes {
            sum = sum + *slope * self.unknown(*index);
        }
        if let Some(friction) = self.friction_work(column) {
            sum = sum + friction;
        }
        (sum, slopes)
    }

    /// The powers of everything that acts: efforts, loads, weights, springs, inertia, friction, and their sum.
    pub(super) fn powers(&self) -> [Var<'t>; 7] {
        let zero = self.tape().constant(0.0);
        let s = &self.real;
        let [mut efforts, mut loads, mut weights, mut springs, mut inertia] = [zero; 5];
        for (index, sought) in self.burden.sought.iter().enumerate() {
            if let Sought::Effort(input) = *sought
                && let Some(row) = self.model.effort_row(input)
            {
                // The rate of the input's own equation, whose driving function rests.
                efforts = efforts + self.effort(index) * s.row(&row).d;
            }
        }
        let power = |force: [Var<'t>; 2], site: &Site| {
            let velocity = s.site(site).map(|c| c.d);
            force[0] * velocity[0] + force[1] * velocity[1]
        };
        for load in &self.burden.loads {
            let [x, y, torque] = self.load(load);
            let of = match &load.at {
                Some(at) => power([x, y], at),
                None => torque * s.angle(load.body).d,
            };
            let of = of * self.part(load.body);
            match load.size {
                LoadSize::Sought(_) => efforts = efforts + of,
                _ => loads = loads + of,
            }
        }
        for spring in &self.burden.springs {
            let length = Self::length(s, spring);
            let of = -(self.pull_of(spring, length.v) * length.d * self.part_of_spring(spring));
            match spring.law {
                BodyLaw::StiffnessSought(..) | BodyLaw::ForceSought(_) => efforts = efforts + of,
                _ => springs = springs + of,
            }
        }
        for heavy in &self.burden.masses {
            if let Some(weight) = self.weight(heavy) {
                weights = weights + power(weight, &heavy.centre) * self.part(heavy.centre.body);
            }
            if self.moves {
                let (force, couple) = self.inertial(heavy);
                let of = power(force, &heavy.centre) + couple * s.angle(heavy.centre.body).d;
                inertia = inertia + of * self.part(heavy.centre.body);
            }
            if let Some(spin) = &self.burden.spin {
                let of = power(self.centrifugal(heavy), &heavy.centre) * self.part(heavy.centre.body);
                match spin.omega {
                    Ok(_) => inertia = inertia + of,
                    Err(_) => efforts = efforts + of,
                }
            }
        }
        // The drag of a sleeve is a load on it.
        if let Some((row, size)) = self.burden.spin.as_ref().and_then(|spin| self.drag(spin)) {
            loads = loads + size * s.row(&row).d;
        }
        let friction = self.friction_power().unwrap_or(zero);
        let sum = efforts + loads + weights + springs + inertia + friction;
        [efforts, loads, weights, springs, inertia, friction, sum]
    }
}

impl Burden {
    /// Compiles what acts on a mechanism.
    pub(super) fn new(model: &mut Model) -> Result<Self, AnalyticError> {
        let mechanism = std::sync::Arc::clone(&model.mechanism);
        let forces = &mechanism.forces;
        let (length, time) = (model.length, model.time);
        let force = length / (time * time);
        let torque = force * length;
        let g = model.given(forces.gravity.g, force);
        let direction = model.given(forces.gravity.direction, 1.0);
        let sought = mechanism.sought();
        // Asked only of what is sought.
        let place = |wanted: Sought| sought.iter().take_while(|s| **s != wanted).count();
        let mut burden = Self { gravity: forces.gravity.acts.then_some([g, direction]), ..Self::default() };
        for mass in &forces.masses {
            let centre = site_in(model, mass.centre, mass.link)?;
            let heaviness = match mass.heaviness {
                Heaviness::Mass(mass) => Heavy::Mass(model.given(mass, 1.0)),
                Heaviness::Weight(weight) => Heavy::Weight([model.given(weight, force), g]),
                Heaviness::None => Heavy::None,
            };
            let square = length * length;
            let inertia = match mass.inertia {
                Inertia::Point => Turning::Point,
                Inertia::Central(inertia) => Turning::Central(model.given(inertia, square)),
                Inertia::About(point, inertia) => {
                    Turning::About(site_in(model, point, mass.link)?.own, model.given(inertia, square))
                }
                Inertia::Gyration(radius) => Turning::Gyration(model.given(radius, length)),
            };
            burden.masses.push(HeavyBody { link: mass.link, centre, heaviness, inertia });
        }
        burden.turned = model.input_angle();
        for (index, load) in forces.loads.iter().enumerate() {
            let curves = (&forces.curves[..], &mut burden.curves);
            burden.loads.push(match load.kind {
                LoadKind::Torque { size, with_motion } => BodyLoad {
                    body: load.link.0,
                    at: None,
                    size: load_size(model, curves, size, torque, place(Sought::Load(index))),
                    pointing: match with_motion {
                        Some(with) => Toward::Motion(if with { 1.0 } else { -1.0 }),
                        None => Toward::World(Num::Exact(0.0)),
                    },
                    unaimed: false,
                },
                LoadKind::Vector { at, parts, of } => BodyLoad {
                    body: load.link.0,
                    at: Some(site_in(model, at, load.link)?),
                    size: LoadSize::Pair(parts.map(|part| model.given(part, force))),
                    pointing: Toward::Own(of.0, Num::Exact(0.0)),
                    unaimed: false,
                },
                LoadKind::Force { at, size, pointing } => BodyLoad {
                    body: load.link.0,
                    at: Some(site_in(model, at, load.link)?),
                    size: load_size(model, curves, size, force, place(Sought::Load(index))),
                    pointing: match pointing {
                        Pointing::World(angle) => Toward::World(model.given(angle, 1.0)),
                        Pointing::Own { link, angle } => Toward::Own(link.0, model.given(angle, 1.0)),
                        Pointing::Between { from, to, turned } => {
                            let ends = [any_site(model, from)?, any_site(model, to)?];
                            Toward::Between(ends, model.given(turned, 1.0))
                        }
                        Pointing::Motion { with } => Toward::Motion(if with { 1.0 } else { -1.0 }),
                    },
                    unaimed: false,
                },
            });
        }
        for (index, spring) in forces.springs.iter().enumerate() {
            let (between, force, length) = match spring.kind {
                SpringKind::Pull([first, second]) => {
                    let ends = [site_in(model, first.1, first.0)?, site_in(model, second.1, second.0)?];
                    (Between::Places(ends), force, length)
                }
                SpringKind::Torsion(links) => (Between::Bodies(links.map(|link| link.0)), torque, 1.0),
            };
            let (index, wound) = (place(Sought::Spring(index)), spring.wound);
            let law = match spring.law {
                SpringLaw::Stiffness { stiffness: Size::Given(stiffness), free } => {
                    let stiffness = model.given(stiffness, force / length);
                    BodyLaw::Stiffness(stiffness, model.given(free, length))
                }
                SpringLaw::Stiffness { free, .. } => {
                    BodyLaw::StiffnessSought(index, model.given(free, length))
                }
                SpringLaw::Force(Size::Given(pull)) => BodyLaw::Force(model.given(pull, force)),
                SpringLaw::Force(_) => BodyLaw::ForceSought(index),
            };
            burden.springs.push(BodySpring { between, law, wound, unaimed: false });
        }
        if let Some(spin) = &forces.spin {
            let drag = match spin.drag {
                Some(drag) => {
                    let pair = mechanism.slides[drag.slide];
                    let site = model.rider_site(&pair.rider, pair.guide.link)?;
                    let size = model.given(drag.size, force);
                    match model.track(drag.slide) {
                        Some(Track::Line(line)) => Some((site, *line, size)),
                        Some(Track::Arc(_)) | None => None,
                    }
                }
                None => None,
            };
            burden.spin = Some(BodySpin {
                through: model.given_own(LinkId::FRAME, spin.through),
                angle: model.given(spin.angle, 1.0),
                omega: match spin.omega {
                    SpinSpeed::Given(omega) => Ok(model.given(omega, 1.0 / time)),
                    SpinSpeed::Sought => Err(place(Sought::Spin)),
                },
                drag,
            });
        }
        if let Some(slide) = mechanism.sleeve_slide().filter(|_| !forces.friction.is_empty()) {
            let pair = mechanism.slides[slide];
            let site = model.rider_site(&pair.rider, pair.guide.link)?;
            if let Some(Track::Line(line)) = model.track(slide) {
                burden.sleeve = Some((site, *line));
            }
        }
        burden.pairs = model.pair_rows()?;
        burden.mesh(model)?;
        burden.rubbing = Rubbing::all(model, &burden.pairs)?;
        burden.sought = sought;
        Ok(burden)
    }

    /// Tells apart the rolling pairs that keep their own contact and those whose distance others hold.
    fn mesh(&mut self, model: &mut Model) -> Result<(), AnalyticError> {
        let mechanism = std::sync::Arc::clone(&model.mechanism);
        for (place, (row, tie)) in self.pairs.iter().enumerate() {
            let Tie::Roll(roll) = *tie else { continue };
            let inside = matches!(mechanism.rolls[roll], Roll::Circles { internal: true, .. });
            // Wheels that go apart come nearer to each other's centre where one is in the other.
            let sign = if inside { -1.0 } else { 1.0 };
            let keeps = |row: &Row| matches!(row, Row::Touch { .. } | Row::TouchLine { .. });
            let own_contact = self.pairs.iter().any(|(row, other)| other == tie && keeps(row));
            if keeps(row) {
                self.contacts.push((place, sign, roll));
            } else if let (false, Some(pressure)) = (own_contact, mechanism.forces.pressure(roll)) {
                let pressure = model.given(pressure, 1.0);
                self.meshes.push((place, Mesh { distance: model.distance_row(roll)?, sign, pressure }));
            }
        }
        Ok(())
    }

    /// The senses in which teeth drive, by the multipliers of a balance.
    pub(super) fn driven(&self, x: &[f64]) -> Vec<f64> {
        self.meshes.iter().map(|(place, _)| if x[*place] < 0.0 { -1.0 } else { 1.0 }).collect()
    }

    pub(super) fn unknowns(&self) -> usize {
        self.pairs.len() + self.sought.len()
    }
}

fn load_size(
    model: &mut Model,
    (given, known): (&[Curve], &mut Vec<BodyCurve>),
    size: Size,
    unit: f64,
    sought: usize,
) -> LoadSize {
    let (length, pressure_unit) = (model.length, unit / (model.length * model.length));
    let mut curve = |model: &mut Model, index: usize, unit: f64| {
        known.push(model.curve(&given[index], unit));
        Level::Curve(known.len() - 1)
    };
    match size {
        Size::Given(given) => LoadSize::One(Level::One(model.given(given, unit))),
        Size::Curve(index) => LoadSize::One(curve(model, index, unit)),
        Size::Sought => LoadSize::Sought(sought),
        Size::Pressure { pressure, area } => {
            let pressure = match pressure {
                Pressure::Given(pressure) => Level::One(model.given(pressure, pressure_unit)),
                Pressure::Curve(index) => curve(model, index, pressure_unit),
            };
            match area {
                Area::Given(area) => LoadSize::PressureOn(pressure, model.given(area, length * length)),
                Area::Bore { bore, rod } => {
                    let rod = rod.map_or(Num::Exact(0.0), |rod| model.given(rod, length));
                    LoadSize::Pressure(pressure, [model.given(bore, length), rod])
                }
            }
        }
    }
}

impl Model {
    /// A curve whose sizes are counted in this unit.
    fn curve(&mut self, curve: &Curve, unit: f64) -> BodyCurve {
        match curve {
            Curve::Table { knots, period } => BodyCurve::Table {
                angles: knots.iter().map(|[at, _]| at.value).collect(),
                knots: knots
                    .iter()
                    .map(|[at, size]| [self.given(*at, 1.0), self.given(*size, unit)])
                    .collect(),
                turn: period.value,
                period: self.given(*period, 1.0),
            },
            Curve::Harmonics { constant, sin, cos } => {
                let constant = self.given(*constant, unit);
                let all = sin.iter().map(|wave| (wave, true)).chain(cos.iter().map(|wave| (wave, false)));
                let waves = all.map(|(wave, sine)| BodyWave {
                    order: self.given(wave.order, 1.0),
                    size: self.given(wave.size, unit),
                    sine,
                });
                BodyCurve::Harmonics { constant, waves: waves.collect() }
            }
        }
    }

    /// How the angle of the first input is known; not at all where it drives a slide.
    fn input_angle(&mut self) -> Option<InputAngle> {
        let mechanism = std::sync::Arc::clone(&self.mechanism);
        match mechanism.inputs.first()? {
            Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. } => {
                Some(InputAngle::Given(self.given(*angle, 1.0)))
            }
            Input::Angle { link, .. } | Input::Speed { link, .. } => {
                let [first, second, ..] = *mechanism.links[link.0].joints() else { return None };
                let ends = [site_in(self, first, *link).ok()?, site_in(self, second, *link).ok()?];
                Some(InputAngle::Line(ends))
            }
            Input::Slide { .. } => None,
        }
    }
}

/// A point in a link of its own.
fn site_in(model: &Model, point: PointId, link: LinkId) -> Result<Site, AnalyticError> {
    let sites = &model.sites[point.0];
    sites.iter().find(|site| site.body == link.0).copied().ok_or_else(|| AnalyticError::Malformed {
        what: format!("{} is not in its link", model.mechanism.points[point.0].name),
    })
}

fn any_site(model: &Model, point: PointId) -> Result<Site, AnalyticError> {
    model.sites[point.0].first().copied().ok_or_else(|| AnalyticError::Malformed {
        what: format!("{} is in no link", model.mechanism.points[point.0].name),
    })
}

/// How a direction is told, as numbers that are not all zero.
#[derive(Debug, Clone, Copy)]
pub(super) enum Aim {
    /// By the way from one place to another.
    Between([Site; 2]),
    /// By the velocity of a place.
    Velocity(Site),
    /// By the sense in which a body turns.
    Turning(usize),
}

impl Burden {
    /// What has a direction by places or by the motion.
    pub(super) fn aims(&self) -> Vec<(Unaimed, Aim)> {
        let loads = self.loads.iter().enumerate().filter_map(|(index, load)| {
            let aim = match (load.pointing, load.at) {
                (Toward::Between(ends, _), _) => Aim::Between(ends),
                (Toward::Motion(_), Some(at)) => Aim::Velocity(at),
                (Toward::Motion(_), None) => Aim::Turning(load.body),
                _ => return None,
            };
            Some((Unaimed::Load(index), aim))
        });
        let springs = self.springs.iter().enumerate();
        let springs = springs.filter_map(|(index, spring)| match spring.between {
            Between::Places(ends) => Some((Unaimed::Spring(index), Aim::Between(ends))),
            Between::Bodies(_) => None,
        });
        loads.chain(springs).collect()
    }

    /// Notes that something has no direction here.
    pub(super) fn leave_out(&mut self, what: Unaimed, why: Indeterminate) {
        match what {
            Unaimed::Load(index) => self.loads[index].unaimed = true,
            Unaimed::Spring(index) => self.springs[index].unaimed = true,
        }
        self.unaimed.get_or_insert(why);
    }

    /// Whether something without a direction acts on a body, in a share of what acts.
    pub(super) fn strays_on(&self, body: usize, share: Share) -> bool {
        let counts = |sought: bool| sought || share != Share::Inertia;
        let load = |load: &BodyLoad| {
            load.unaimed && load.body == body && counts(matches!(load.size, LoadSize::Sought(_)))
        };
        let spring = |spring: &BodySpring| {
            let sought = matches!(spring.law, BodyLaw::StiffnessSought(..) | BodyLaw::ForceSought(_));
            spring.unaimed && spring.bodies().contains(&body) && counts(sought)
        };
        self.loads.iter().any(load) || self.springs.iter().any(spring)
    }
}

/// Which balances hang on which unknowns, and how far off their slopes may be.
#[derive(Default)]
pub(super) struct Slopes {
    pub(super) errors: HashMap<(usize, usize), f64>,
    pub(super) pattern: Vec<Vec<usize>>,
}

/// The balance of one share of what acts, to be evaluated.
pub(super) struct Balancing<'a> {
    model: &'a Model,
    pub(super) burden: &'a Burden,
    located: &'a Located,
    motion: Motion<'a>,
    share: Share,
    moves: bool,
}

impl<'a> Balancing<'a> {
    /// The bodies that are out of balance where a size that is sought elsewhere than at an input is not determined: those
    /// on which it acts, and those that are driven.
    pub(super) fn unbalanced(&self, undetermined: &[bool]) -> Vec<usize> {
        let mechanism: &Mechanism = &self.model.mechanism;
        let sizes = &undetermined[self.burden.pairs.len()..];
        let lost = self.burden.sought.iter().zip(sizes).filter(|(_, lost)| **lost).map(|(sought, _)| *sought);
        let mut links: Vec<LinkId> = lost
            .filter(|sought| !mechanism.is_sought_at_input(*sought))
            .flat_map(|sought| mechanism.loaded_by(sought))
            .collect();
        if !links.is_empty() {
            for input in 0..mechanism.inputs.len() {
                links.extend(mechanism.driven_link(input));
                links.extend(mechanism.driven_between(input));
            }
        }
        links.into_iter().filter(|link| *link != LinkId::FRAME).map(|link| link.0).collect()
    }

    /// Of what acts.
    pub(super) const fn share(&self) -> Share {
        self.share
    }

    pub(super) fn new(
        model: &'a Model,
        burden: &'a Burden,
        located: &'a Located,
        solved: Option<&'a Solved>,
        share: Share,
    ) -> Self {
        let moves = solved.is_some_and(|solved| !solved.accel.is_empty());
        let (rate, accel): (&[f64], &[f64]) = solved.map_or((&[], &[]), |s| (&s.rate, &s.accel));
        let motion = Motion { pose: &located.pose, rate, accel, params: &model.params };
        Self { model, burden, located, motion, share, moves }
    }

    /// The balances with these unknowns, and which of them hang on which.
    pub(super) fn linear(
        &self,
        x: &[f64],
        strength: &Strength,
    ) -> Result<(Vec<Linear>, Slopes), AnalyticError> {
        let mut known = Slopes::default();
        let rows = self.evaluate(x, strength, Some(&mut known))?;
        Ok((rows, known))
    }

    /// The balances with these unknowns.
    pub(super) fn evaluate(
        &self,
        x: &[f64],
        strength: &Strength,
        mut first: Option<&mut Slopes>,
    ) -> Result<Vec<Linear>, AnalyticError> {
        let Self { model, burden, located, motion, share, moves } = *self;
        (3..3 * model.bodies)
            .map(|column| {
                let tape = Tape::new(if moves { 2 } else { 1 });
                let scope = Scope { tape: &tape, motion };
                let acting = Acting::new(scope, (model, burden), (x, strength), share, moves);
                let (sum, slopes) = acting.balance(column);
                if let Some(first) = first.as_deref_mut() {
                    let mut used = Vec::new();
                    for (index, slope) in slopes {
                        let linear = tape.sweep(slope);
                        let steady = linear.terms.is_empty() && linear.rounding == 0.0;
                        if steady && linear.value == 0.0 {
                            continue;
                        }
                        used.push(index);
                        let spread = linear.terms.iter().map(|(leaf, c)| match leaf {
                            Leaf::Pose(at) => c.abs() * located.error[*at],
                            Leaf::Param(at) => c.abs() * model.params[*at].error,
                            Leaf::Rate(_) | Leaf::Accel(_) | Leaf::Force(_) => 0.0,
                        });
                        let error = spread.filter(|e| *e > 0.0).sum::<f64>() + linear.rounding;
                        *first.errors.entry((column - 3, index)).or_default() += error;
                    }
                    used.sort_unstable();
                    used.dedup();
                    first.pattern.push(used);
                }
                let linear = tape.sweep(sum);
                let sound = !tape.broken() && linear.value.is_finite() && linear.rounding.is_finite();
                sound.then_some(linear).ok_or(AnalyticError::Directionless)
            })
            .collect()
    }
}

/// Solves the balance of one share of what acts, where nothing rubs. Which way teeth drive does not hang on how they push
/// apart, since others hold their distance: it is that of smooth wheels.
pub(super) fn balance(balancing: &Balancing<'_>) -> Result<Balance, AnalyticError> {
    let smooth = balance_with(balancing, Strength::default())?;
    let meshes = balancing.burden.driven(&smooth.x);
    if meshes.is_empty() {
        return Ok(smooth);
    }
    balance_with(balancing, Strength { meshes, ..Strength::default() })
}

/// Solves it where teeth drive in these senses.
fn balance_with(balancing: &Balancing<'_>, strength: Strength) -> Result<Balance, AnalyticError> {
    let n = balancing.burden.unknowns();
    let mut x = vec![0.0; n];
    let (mut rows, known) = balancing.linear(&x, &strength)?;
    let Ordering { groups, free, .. } = order(&known.pattern, n);
    let mut system = System::new(groups, &rows, n, |leaf| match leaf {
        Leaf::Force(at) => Some(at),
        _ => None,
    });
    let mut undetermined = vec![false; n];
    for column in &free {
        undetermined[*column] = true;
    }
    for index in 0..system.blocks.len() {
        let error = |row: usize, column: usize| match known.errors.get(&(row, column)) {
            Some(error) => *error,
            // A balance that does not hang on the unknown.
            None => 0.0,
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
    for _ in 0..=REFINEMENTS {
        let residuals: Vec<f64> = rows.iter().map(|linear| -linear.value).collect();
        let correction = system.solve(&residuals, &undetermined);
        if correction.iter().all(|d| *d == 0.0) {
            break;
        }
        for (x, d) in x.iter_mut().zip(correction) {
            *x += d;
        }
        rows = balancing.evaluate(&x, &strength, None)?;
    }
    let unbalanced = balancing.unbalanced(&undetermined);
    Ok(Balance { x, rows, system, undetermined, unbalanced, strength })
}

/// The equations of pairs, each with the pair of which it is.
impl Model {
    /// The equation whose multiplier is the effort at an input; the driving function rests.
    pub(super) fn effort_row(&self, input: usize) -> Option<Row> {
        let zero = Num::Exact(0.0);
        let drive = Drive { value: zero, rate: zero, arm: None, second: zero };
        let mechanism: &Mechanism = &self.mechanism;
        match mechanism.inputs.get(input)? {
            Input::Angle { link, .. } | Input::Speed { link, .. } => Some(Row::Turn(link.0, None, drive)),
            Input::Slide { .. } => {
                let (site, line) = self.effort_line(input)?;
                Some(Row::Push(site, line, drive))
            }
        }
    }

    /// Where the effort at a driven slide acts, and along which line.
    pub(super) fn effort_line(&self, input: usize) -> Option<(Site, Straight)> {
        let mechanism: &Mechanism = &self.mechanism;
        let Input::Slide { slide, .. } = mechanism.inputs.get(input)? else { return None };
        let pair = &mechanism.slides[*slide];
        let site = self.rider_site(&pair.rider, pair.guide.link).ok()?;
        match self.track(*slide)? {
            Track::Line(line) => Some((site, *line)),
            Track::Arc(_) => None,
        }
    }
}
