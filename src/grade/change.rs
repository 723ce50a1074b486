//! What a mistake changes: the mechanism that was solved, the drawing, or what was read off it.

use std::borrow::Cow;

use crate::given::Given;
use crate::graphical::construction::Label;
use crate::graphical::{Departure, Twist};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::statement::Locus;
use crate::mechanism::{Form, GuidePoint, Input, Mechanism, Path, Place, Roll};

/// All that one mistake, or several together, change.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Change {
    pub(super) inputs: Vec<InputChange>,
    pub(super) departures: Vec<Departure>,
    pub(super) readings: Vec<Misreading>,
}

/// What was given was taken otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum InputChange {
    /// ω and α of every input are multiplied (of a slide its velocity and acceleration).
    Rates { omega: f64, alpha: f64 },
    /// Every length is multiplied; the given speeds of points and slides as well, or not.
    Lengths { factor: f64, speeds: bool },
}

/// What was drawn was read or written down otherwise.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Misreading {
    /// Multiplied and turned.
    Twisted { of: Which, twist: Twist },
    /// The length on paper was written down as a number of the answer's unit, times this.
    Unscaled { of: Which, factor: f64 },
    /// The length on paper was divided by the scale (in units of the answer per millimetre), times this.
    Divided { of: Which, factor: f64 },
    /// The vector was measured from the pole or from another image, instead of from its own tail.
    MeasuredFrom { of: Quantity, tail: Label },
    /// Its relative vector was laid off backwards from another image.
    Backwards { of: Quantity, from: Label },
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
}

impl Change {
    pub(super) fn of_inputs(change: InputChange) -> Self {
        Self { inputs: vec![change], ..Self::default() }
    }

    pub(super) fn drawn(departures: Vec<Departure>) -> Self {
        Self { departures, ..Self::default() }
    }

    pub(super) fn read(reading: Misreading) -> Self {
        Self { readings: vec![reading], ..Self::default() }
    }

    /// Both changes.
    pub(super) fn and(&self, other: &Self) -> Self {
        Self {
            inputs: [&self.inputs[..], &other.inputs[..]].concat(),
            departures: [&self.departures[..], &other.departures[..]].concat(),
            readings: [&self.readings[..], &other.readings[..]].concat(),
        }
    }

    /// Whether anything is drawn otherwise.
    pub(super) fn redraws(&self) -> bool {
        !(self.inputs.is_empty() && self.departures.is_empty())
    }

    /// The mechanism that was solved.
    pub(super) fn mechanism<'m>(&self, right: &'m Mechanism) -> Cow<'m, Mechanism> {
        let mut mechanism = Cow::Borrowed(right);
        for change in &self.inputs {
            match *change {
                InputChange::Rates { omega, alpha } => drive(mechanism.to_mut(), omega, alpha),
                InputChange::Lengths { factor, speeds } => enlarge(mechanism.to_mut(), factor, speeds),
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
            && !matches!(quantity, Quantity::Position(_) | Quantity::Centre(..));
        match self {
            Self::One(one) => one == *quantity,
            Self::Vectors(order) => vector && quantity.order() == order,
            Self::AllVectors => vector,
            Self::AllLinear => vector || matches!(quantity, Quantity::Rub(..)),
        }
    }
}
