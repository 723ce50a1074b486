//! What a mistake changes: the mechanism that was solved, the drawing, or what was read off it.

use std::borrow::Cow;

use crate::given::Given;
use crate::graphical::construction::{Claim, Label, Reference};
use crate::graphical::{Departure, Twist};
use crate::mechanism::curve::Curve;
use crate::mechanism::cycle::{Course, RotatingInertia, Sides};
use crate::mechanism::force::{Inertia, LoadKind, Pointing, Pressure, Size, SpringKind, SpringLaw};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::statement::Locus;
use crate::mechanism::{Form, GuidePoint, Input, LinkId, Mechanism, Path, Place, PointId, Roll, Sense};

/// All that one mistake, or several together, change.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Change {
    pub(super) inputs: Vec<InputChange>,
    pub(super) departures: Vec<Departure>,
    /// Lines that were drawn by another line of the skeleton than they should be.
    pub(super) strays: Vec<Stray>,
    pub(super) readings: Vec<Misreading>,
}

/// A line of a polygon that was drawn parallel or square to the wrong line of the skeleton.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stray {
    pub(super) order: Order,
    /// The direction that it should have.
    pub(super) claim: Claim,
    /// The line by which it was drawn.
    pub(super) by: Reference,
    /// Square to that line, not parallel.
    pub(super) square: bool,
}

/// What was given was taken otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum InputChange {
    /// ω and α of every input are multiplied (of a slide its velocity and acceleration).
    Rates { omega: f64, alpha: f64 },
    /// The angle of an input (by its index) is larger by so many radians.
    Angle { input: usize, by: f64 },
    /// The length between two joints of a link, by their places in it, is multiplied.
    Length { link: LinkId, ends: [usize; 2], factor: f64 },
    /// Every length is multiplied; the given speeds of points and slides as well, or not.
    Lengths { factor: f64, speeds: bool },
    /// The arm from a link's first joint to another of its points, by its place in it, is multiplied and turned ccw, radians.
    Arm { link: LinkId, end: usize, factor: f64, turn: f64 },
    /// A straight guide, by its index among the slides, lies so far to its left, metres, and is turned ccw, radians.
    Guide { slide: usize, across: f64, turn: f64 },
    /// A fixed point stands so far from its place, metres.
    Pivot { point: PointId, by: [f64; 2] },
    /// A load, by its index, is multiplied.
    Load { index: usize, factor: f64 },
    /// A load whose direction is stated in the world, by its index, is turned by so many radians.
    LoadTurned { index: usize, by: f64 },
    /// The period of the turning-moment diagram is multiplied.
    Period(f64),
    /// A value of the table of the turning-moment diagram, by its index, is multiplied.
    Knot { index: usize, factor: f64 },
    /// The wanted fluctuation of speed is multiplied.
    Fluctuation(f64),
    /// The inertia of what turns with the input, by its index, is multiplied.
    Rotating { index: usize, factor: f64 },
}

/// What was drawn was read or written down otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Misreading {
    /// Multiplied and turned.
    Twisted { of: Which, twist: Twist },
    /// The direction was counted clockwise from the x axis, or from the y axis.
    Mirrored { of: Which, from_y: bool },
    /// The length on paper was written down as a number of the answer's unit, times this.
    Unscaled { of: Which, factor: f64 },
    /// The length on paper was multiplied by a scale that is so many times the right one; the length itself is right.
    OtherScale { of: Which, factor: f64 },
    /// The length on paper was divided by the scale (in units of the answer per millimetre), times this.
    Divided { of: Which, factor: f64 },
    /// The value was multiplied by the scale (in units of the answer per millimetre) once more, times this.
    ScaledTwice { of: Which, factor: f64 },
    /// A number of the turning-moment diagram was calculated with so many times the angular velocity, it alone.
    RateIn { of: Quantity, omega: f64 },
    /// The points of a figure, and the lengths that were measured on it, are multiplied.
    Enlarged { order: Order, factor: f64 },
    /// The points of a figure are turned about its pole, radians.
    Turned { order: Order, by: f64 },
    /// The vector was measured from the pole or from another image, instead of from its own tail.
    MeasuredFrom { of: Quantity, tail: Label },
    /// The vector was measured to another image than its own head.
    MeasuredTo { of: Quantity, head: Label },
    /// Its relative vector was laid off backwards from another image.
    Backwards { of: Quantity, from: Label },
    /// Directions went through a calculator that computes in radians.
    InRadians { of: Which, how: InRadians },
    /// The number was handed in the other way up.
    Inverted { of: Quantity },
    /// It was rounded to two figures of the unit in which it is handed in.
    Rounded { of: Quantity },
    /// Another answer's numbers were handed in for it.
    TakenFor { of: Quantity, by: Quantity },
    /// An image bears the letter of another one.
    LetterOf { order: Order, of: Label, by: Label },
    /// Another vector was added to it, SI.
    Plus { of: Quantity, by: [f64; 2] },
    /// The fluctuation of energy is multiplied, and with it what is reckoned from it beside this inertia, kg m².
    Fluctuation { factor: f64, inertia: f64 },
}

/// How a calculator set to radians spoils a direction.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct InRadians {
    /// The degrees were typed into a sine or cosine; otherwise radians came out of an arc tangent and were written
    /// down as degrees.
    pub(super) typed: bool,
    /// Directions were counted from 0 to a whole turn, otherwise from minus to plus half a turn.
    pub(super) from_zero: bool,
}

impl InRadians {
    /// What becomes of a direction, radians.
    pub(super) fn spoilt(self, angle: f64) -> f64 {
        let angle = if self.from_zero && angle < 0.0 { angle + 2.0 * std::f64::consts::PI } else { angle };
        if self.typed { angle.to_degrees() } else { angle.to_radians() }
    }
}

/// Which answers were misread.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Which {
    One(Quantity),
    /// All vectors of a polygon.
    Vectors(Order),
    /// All vectors of both polygons.
    AllVectors,
    /// All velocities and accelerations, rates not.
    AllLinear,
    /// The vectors of a polygon that are read off it, and not calculated before they are laid off.
    Read(Order),
    /// Of these what is not the sum of two parts that are given.
    Found(Order),
    /// Of those that are read what is measured, and not calculated by the rate of its link.
    Measured(Order),
    /// All angular velocities.
    Omegas,
}

impl Change {
    pub(super) fn of_inputs(change: InputChange) -> Self {
        Self { inputs: vec![change], ..Self::default() }
    }

    pub(super) fn drawn(departures: Vec<Departure>) -> Self {
        Self { departures, ..Self::default() }
    }

    pub(super) fn strayed(stray: Stray) -> Self {
        Self { strays: vec![stray], ..Self::default() }
    }

    pub(super) fn read(reading: Misreading) -> Self {
        Self { readings: vec![reading], ..Self::default() }
    }

    /// Both changes.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            inputs: [&self.inputs[..], &other.inputs[..]].concat(),
            departures: [&self.departures[..], &other.departures[..]].concat(),
            strays: [&self.strays[..], &other.strays[..]].concat(),
            readings: [&self.readings[..], &other.readings[..]].concat(),
        }
    }

    /// Whether anything is drawn otherwise.
    pub(super) fn redraws(&self) -> bool {
        !(self.inputs.is_empty() && self.departures.is_empty() && self.strays.is_empty())
    }

    /// Whether the skeleton is laid off otherwise: then all that is found from it is otherwise.
    pub(super) fn relays(&self) -> bool {
        let laid_off = |change: &InputChange| {
            matches!(
                change,
                InputChange::Length { .. }
                    | InputChange::Arm { .. }
                    | InputChange::Guide { .. }
                    | InputChange::Pivot { .. }
                    | InputChange::Angle { .. }
            )
        };
        self.inputs.iter().any(laid_off)
    }

    /// Whether a polygon is drawn otherwise, or something is read off it or calculated from it otherwise on the way.
    pub(super) fn departs_in(&self, order: Order) -> bool {
        let departs = |departure: &Departure| match departure {
            Departure::LaidOff { quantity, .. } | Departure::Read { quantity, .. } => {
                quantity.order() == order
            }
            Departure::Ray { order: of, .. }
            | Departure::ReadAll { order: of, .. }
            | Departure::Rate { order: of, .. }
            | Departure::RateIs { order: of, .. }
            | Departure::Image { order: of, .. }
            | Departure::Under { order: of, .. }
            | Departure::Mirrored { order: of, .. }
            | Departure::Backwards { order: of, .. } => *of == order,
            _ => false,
        };
        self.departures.iter().any(departs) || self.strays.iter().any(|stray| stray.order == order)
    }

    /// The mechanism that was solved.
    pub(super) fn mechanism<'m>(&self, right: &'m Mechanism) -> Cow<'m, Mechanism> {
        let mut mechanism = Cow::Borrowed(right);
        for change in &self.inputs {
            match *change {
                InputChange::Rates { omega, alpha } => drive(mechanism.to_mut(), omega, alpha),
                InputChange::Angle { input, by } => turn(mechanism.to_mut(), input, by),
                InputChange::Length { link, ends, factor } => stretch(mechanism.to_mut(), link, ends, factor),
                InputChange::Arm { link, end, factor, turn } => {
                    swing(mechanism.to_mut(), (link, end), factor, turn);
                }
                InputChange::Guide { slide, across, turn } => shift(mechanism.to_mut(), slide, across, turn),
                InputChange::Lengths { factor, speeds } => enlarge(mechanism.to_mut(), factor, speeds),
                InputChange::Pivot { point, by } => {
                    if let Some(Place::Fixed(at)) =
                        mechanism.to_mut().points.get_mut(point.0).map(|point| &mut point.place)
                    {
                        *at = [0, 1].map(|axis| Given::exact(at[axis].value + by[axis]));
                    }
                }
                InputChange::Load { index, factor } => {
                    if let Some(load) = mechanism.to_mut().forces.loads.get_mut(index) {
                        enlarge_load(&mut load.kind, factor);
                    }
                }
                InputChange::LoadTurned { index, by } => {
                    if let Some(LoadKind::Force { pointing: Pointing::World(angle), .. }) =
                        mechanism.to_mut().forces.loads.get_mut(index).map(|load| &mut load.kind)
                    {
                        *angle = Given::exact(angle.value + by);
                    }
                }
                InputChange::Period(factor) => {
                    if let Some(cycle) = &mut mechanism.to_mut().forces.cycle {
                        cycle.period = cycle.period.times(factor);
                    }
                }
                InputChange::Knot { index, factor } => {
                    if let Some(
                        Sides::Torque(Course::Curve(Curve::Table { knots, .. }))
                        | Sides::Load(Course::Curve(Curve::Table { knots, .. })),
                    ) = mechanism.to_mut().forces.cycle.as_mut().map(|cycle| &mut cycle.sides)
                        && let Some([_, torque]) = knots.get_mut(index)
                    {
                        *torque = torque.times(factor);
                    }
                }
                InputChange::Fluctuation(factor) => {
                    if let Some(cycle) = &mut mechanism.to_mut().forces.cycle {
                        cycle.fluctuation = cycle.fluctuation.map(|given| given.times(factor));
                    }
                }
                InputChange::Rotating { index, factor } => {
                    let cycle = mechanism.to_mut().forces.cycle.as_mut();
                    let rotating = cycle.and_then(|cycle| cycle.rotating.get_mut(index));
                    if let Some(rotating) = rotating {
                        let (RotatingInertia::Central(of)
                        | RotatingInertia::Mass(of, _)
                        | RotatingInertia::Weight(of, _)) = &mut rotating.inertia;
                        *of = of.times(factor);
                    }
                }
            }
        }
        mechanism
    }
}

fn drive(mechanism: &mut Mechanism, first: f64, second: f64) {
    for input in &mut mechanism.inputs {
        let (rate, change) = match input {
            Input::Angle { omega, alpha, .. } => (omega, alpha),
            Input::Speed { speed, alpha, .. } => (speed, alpha),
            Input::Slide { velocity, acceleration, .. } => (velocity, acceleration),
        };
        *rate = rate.times(first);
        *change = change.times(second);
    }
    if let Some(cycle) = &mut mechanism.forces.cycle {
        cycle.omega = cycle.omega.times(first);
    }
}

fn turn(mechanism: &mut Mechanism, input: usize, by: f64) {
    if let Some(Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. }) =
        mechanism.inputs.get_mut(input)
    {
        *angle = Given::exact(angle.value + by);
    }
}

/// A load that is larger; one that follows a curve stays as it is.
fn enlarge_load(kind: &mut LoadKind, factor: f64) {
    let grow = |given: &mut Given| *given = given.times(factor);
    match kind {
        LoadKind::Force { size, .. } | LoadKind::Torque { size, .. } => match size {
            Size::Given(given) | Size::Pressure { pressure: Pressure::Given(given), .. } => grow(given),
            _ => {}
        },
        LoadKind::Vector { parts, .. } => parts.iter_mut().for_each(grow),
    }
}

/// Another length between two joints of a link, where the link is given by it.
fn stretch(mechanism: &mut Mechanism, link: LinkId, ends: [usize; 2], factor: f64) {
    let Some(link) = mechanism.links.get_mut(link.0) else { return };
    let length = match (&mut link.form, ends) {
        (Form::Length(length), [0, 1]) => length,
        (Form::Sides { first_second, .. }, [0, 1]) => first_second,
        (Form::Sides { second_third, .. }, [1, 2]) => second_third,
        (Form::Sides { third_first, .. }, [0, 2]) => third_first,
        (Form::Arms { second, .. }, [0, 1]) => second,
        (Form::Arms { third, .. }, [0, 2]) => third,
        (Form::Line(places), [0, end]) if end < places.len() && places[0].value == 0.0 => &mut places[end],
        _ => return,
    };
    *length = length.times(factor);
}

/// A point of a link elsewhere about the link's first joint, where the link is given by more than a length.
fn swing(mechanism: &mut Mechanism, (link, end): (LinkId, usize), factor: f64, turn: f64) {
    let Some(link) = mechanism.links.get_mut(link.0) else { return };
    match &mut link.form {
        Form::Arms { third, angle, .. } if end == 2 => {
            *third = third.times(factor);
            *angle = Given::exact(angle.value + turn);
        }
        Form::Sides { first_second, second_third, third_first, turn: sense } if end == 2 => {
            let (base, far, arm) = (first_second.value, second_third.value, third_first.value);
            let cosine = (base * base + arm * arm - far * far) / (2.0 * base * arm);
            let angle = libm::acos(cosine.clamp(-1.0, 1.0));
            let angle = if *sense == Sense::Ccw { angle } else { -angle } + turn;
            let arm = arm * factor;
            let square = base * base + arm * arm - 2.0 * base * arm * libm::cos(angle);
            *second_third = Given::exact(square.max(0.0).sqrt());
            *third_first = Given::exact(arm);
            *sense = if libm::sin(angle) < 0.0 { Sense::Cw } else { Sense::Ccw };
        }
        Form::Shape(points) => {
            let Some(&base) = points.first() else { return };
            let Some(point) = points.get_mut(end).filter(|_| end > 0) else { return };
            let [x, y] = [0, 1].map(|axis| point[axis].value - base[axis].value);
            let (sin, cos) = (factor * libm::sin(turn), factor * libm::cos(turn));
            let own = [cos * x - sin * y, sin * x + cos * y];
            *point = [0, 1].map(|axis| Given::exact(base[axis].value + own[axis]));
        }
        _ => {}
    }
}

/// A straight guide elsewhere.
fn shift(mechanism: &mut Mechanism, slide: usize, across: f64, turn: f64) {
    let path = mechanism.slides.get_mut(slide).map(|slide| &mut slide.guide.path);
    if let Some(Path::Straight { turned, offset, .. }) = path {
        *offset = Given::exact(offset.value + across);
        *turned = Given::exact(turned.value + turn);
    }
}

/// The same mechanism, larger.
fn enlarge(mechanism: &mut Mechanism, factor: f64, speeds: bool) {
    let grow = |length: &mut Given| *length = length.times(factor);
    let grow_all = |lengths: &mut [Given]| lengths.iter_mut().for_each(grow);
    for link in &mut mechanism.links {
        match &mut link.form {
            Form::Length(length) => grow(length),
            Form::Line(positions) => grow_all(positions),
            Form::Sides { first_second, second_third, third_first, .. } => {
                [first_second, second_third, third_first].into_iter().for_each(grow);
            }
            Form::Arms { second, third, .. } => [second, third].into_iter().for_each(grow),
            Form::Shape(points) => points.iter_mut().for_each(|p| grow_all(p)),
            Form::Placed | Form::Single => {}
        }
    }
    for point in &mut mechanism.points {
        match &mut point.place {
            Place::Fixed(at) | Place::Placed(at) => grow_all(at),
            Place::Near(at) => at.iter_mut().for_each(|x| *x *= factor),
            Place::Stated(_) | Place::Unknown => {}
        }
        if let Some(journal) = &mut point.journal {
            grow(journal);
        }
    }
    let grow_path = |path: &mut Path| match path {
        Path::Straight { through, offset, .. } => {
            grow_point(through, factor);
            grow(offset);
        }
        Path::Arc { centre, radius } => {
            grow_point(centre, factor);
            grow(radius);
        }
    };
    mechanism.slides.iter_mut().for_each(|slide| grow_path(&mut slide.guide.path));
    for statement in &mut mechanism.statements {
        for locus in statement.all_loci_mut() {
            match locus {
                Locus::Circle { radius, .. } => grow(radius),
                Locus::On(path) => grow_path(path),
                Locus::Ray { .. } | Locus::Square { .. } | Locus::Sees { .. } => {}
            }
        }
        statement.near.iter_mut().flatten().for_each(|x| *x *= factor);
    }
    for roll in &mut mechanism.rolls {
        match roll {
            Roll::Circles { radii, .. } => grow_all(radii),
            Roll::Line { guide, radius, .. } => {
                grow_path(&mut guide.path);
                grow(radius);
            }
        }
    }
    for mass in &mut mechanism.forces.masses {
        if let Inertia::Gyration(radius) = &mut mass.inertia {
            grow(radius);
        }
    }
    for spring in &mut mechanism.forces.springs {
        if let (SpringKind::Pull(_), SpringLaw::Stiffness { free, .. }) = (spring.kind, &mut spring.law) {
            grow(free);
        }
    }
    for input in &mut mechanism.inputs {
        match input {
            Input::Angle { .. } => {}
            Input::Speed { speed, .. } if speeds => grow(speed),
            Input::Speed { .. } => {}
            Input::Slide { at, velocity, acceleration, .. } => {
                if let Some(at) = at {
                    grow(at);
                }
                if speeds {
                    grow(velocity);
                    grow(acceleration);
                }
            }
        }
    }
}

fn grow_point(point: &mut GuidePoint, factor: f64) {
    if let GuidePoint::Own(at) = point {
        at.iter_mut().for_each(|x| *x = x.times(factor));
    }
}

impl Which {
    /// Whether a quantity is among them.
    pub(super) fn includes(self, quantity: &Quantity) -> bool {
        let vector = super::answers::is_vector(quantity)
            && !matches!(quantity, Quantity::Position(_) | Quantity::Centre(..) | Quantity::Force(..));
        match self {
            Self::One(one) => one == *quantity,
            Self::Vectors(order) => vector && quantity.order() == order,
            Self::AllVectors => vector,
            Self::AllLinear => vector || matches!(quantity, Quantity::Rub(..)),
            Self::Read(order) | Self::Found(order) | Self::Measured(order) => {
                let calculated = matches!(
                    quantity,
                    Quantity::RelativeNormal(..)
                        | Quantity::Normal(_)
                        | Quantity::CoincidentNormal(..)
                        | Quantity::SlipNormal(..)
                        | Quantity::Coriolis(..)
                );
                vector && quantity.order() == order && !calculated
            }
            Self::Omegas => matches!(quantity, Quantity::Omega(_) | Quantity::RelativeOmega(..)),
        }
    }
}
