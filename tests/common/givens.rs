//! Every number of a mechanism, to be moved one by one.

use linkgram::given::Given;
use linkgram::mechanism::{
    Direction, Form, Guide, GuidePoint, Input, Mechanism, Path, Place, Point, Rider, Roll,
};

fn point(point: &mut [Given; 2], f: &mut dyn FnMut(&mut Given)) {
    point.iter_mut().for_each(f);
}

fn guide(guide: &mut Guide, f: &mut dyn FnMut(&mut Given)) {
    let own = |p: &mut GuidePoint, f: &mut dyn FnMut(&mut Given)| {
        if let GuidePoint::Own(place) = p {
            point(place, f);
        }
    };
    match &mut guide.path {
        Path::Straight { through, direction, turned, offset } => {
            own(through, f);
            if let Direction::Angle(angle) = direction {
                f(angle);
            }
            f(turned);
            f(offset);
        }
        Path::Arc { centre, radius } => {
            own(centre, f);
            f(radius);
        }
    }
}

/// Calls `f` with every number that the scene gave.
pub(crate) fn each(mechanism: &mut Mechanism, f: &mut dyn FnMut(&mut Given)) {
    for Point { place, journal, .. } in &mut mechanism.points {
        if let Place::Fixed(p) | Place::Placed(p) = place {
            point(p, f);
        }
        journal.iter_mut().for_each(&mut *f);
    }
    for link in &mut mechanism.links {
        match &mut link.form {
            Form::Length(l) => f(l),
            Form::Line(positions) => positions.iter_mut().for_each(&mut *f),
            Form::Sides { first_second, second_third, third_first, .. } => {
                [first_second, second_third, third_first].into_iter().for_each(&mut *f);
            }
            Form::Arms { second, third, angle } => [second, third, angle].into_iter().for_each(&mut *f),
            Form::Shape(points) => points.iter_mut().for_each(|p| point(p, f)),
            Form::Placed | Form::Single => {}
        }
    }
    for slide in &mut mechanism.slides {
        if let Rider::Link { turned: Some(turned), .. } = &mut slide.rider {
            f(turned);
        }
        guide(&mut slide.guide, f);
    }
    for roll in &mut mechanism.rolls {
        match roll {
            Roll::Circles { radii, .. } => radii.iter_mut().for_each(&mut *f),
            Roll::Line { guide: g, radius, .. } => {
                guide(g, f);
                f(radius);
            }
        }
    }
    for input in &mut mechanism.inputs {
        match input {
            Input::Angle { angle, omega, alpha, .. } => {
                angle.iter_mut().for_each(&mut *f);
                f(omega);
                f(alpha);
            }
            Input::Speed { angle, speed, alpha, .. } => {
                angle.iter_mut().for_each(&mut *f);
                f(speed);
                f(alpha);
            }
            Input::Slide { at, velocity, acceleration, .. } => {
                at.iter_mut().for_each(&mut *f);
                f(velocity);
                f(acceleration);
            }
        }
    }
}

/// How many numbers a mechanism has.
pub(crate) fn count(mechanism: &Mechanism) -> usize {
    let mut count = 0;
    each(&mut mechanism.clone(), &mut |_| count += 1);
    count
}

/// The mechanism with one number changed, and that number's value before.
pub(crate) fn with_changed(
    mechanism: &Mechanism,
    index: usize,
    change: impl Fn(f64) -> f64,
) -> (Mechanism, f64) {
    let mut changed = mechanism.clone();
    let (mut at, mut before) = (0, 0.0);
    each(&mut changed, &mut |given| {
        if at == index {
            before = given.value;
            given.value = change(given.value);
        }
        at += 1;
    });
    (changed, before)
}
