//! Whether a drawn skeleton is the mechanism: no link longer than it is, no pin beside its guide, no point elsewhere
//! than where it is placed.
//!
//! A construction uses each dimension once. Where places are given besides, the rest is overdetermined, and what
//! contradicts them shows only when the skeleton stands.

use std::cell::Cell;

use crate::board::{Direction, Line};
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::{Joint, holds_distance};
use crate::mechanism::{Input, LinkId, Place, PointId, Rider, Roll};
use crate::plan::Plan;

use super::draughtsman::Draughtsman;
use super::pose::Track;
use super::{DrawError, Parting, Round, Unplaced};

/// What may be missed by, in sizes of the skeleton: given places may miss dimensions and guides by 1e-6 of the size,
/// and what is constructed from two of them by a little more.
const ROUNDING: f64 = 1e-5;
/// What is missed by less is noise, in sizes of the skeleton, where no place is given that could be missed.
const NOISE: f64 = 1e-11;
/// Units of rounding in a coordinate of a guide that is given by a point of it far away.
const ROUNDINGS: f64 = 16.0;

/// Refuses a skeleton that misses a given place, a dimension, a guide or a rolling contact. Gives the largest miss that is
/// taken as rounding, metres: what the rooms of placed points explain is none.
///
/// # Errors
/// [`DrawError::NoClosure`] with the point that is missed and by how much.
pub(super) fn verify(d: &mut Draughtsman<'_>) -> Result<f64, DrawError> {
    // What is measured here is no part of the drawing.
    d.board.tape().aside(true);
    let verified = verified(d);
    d.board.tape().aside(false);
    verified
}

fn verified(d: &mut Draughtsman<'_>) -> Result<f64, DrawError> {
    let places: Vec<[f64; 2]> = d.places.iter().flatten().map(|at| at.value()).collect();
    let extent = |axis: usize| {
        let all = || places.iter().map(|at| at[axis]);
        all().fold(f64::NEG_INFINITY, f64::max) - all().fold(f64::INFINITY, f64::min)
    };
    // At the scale of a first drawing the longest known length is 100 mm.
    let size = libm::hypot(extent(0), extent(1)).max(100.0);
    let mut farthest: f64 = 0.0;
    for index in 0..d.mechanism.slides.len() {
        if stands(d, d.mechanism.slides[index].guide.link)
            && let Track::Straight(line) = d.track(index, None)
        {
            let [x, y] = line.through.value();
            farthest = farthest.max(libm::hypot(x, y));
        }
    }
    let allowed = ROUNDING * size + ROUNDINGS * f64::EPSILON * farthest;
    let given = d.mechanism.points.iter().any(|point| matches!(point.place, Place::Placed(_)));
    // What the arithmetic leaves is in the bounds already.
    let noise = if given { ROUNDINGS * f64::EPSILON } else { NOISE } * size;
    let noise = noise + ROUNDINGS * f64::EPSILON * farthest;
    let worst = Cell::new(0.0_f64);
    // By as much as what was measured may be off for what is given, a miss is no contradiction.
    let missed = |pin: PointId, miss: f64, measured: &[u32], d: &mut Draughtsman<'_>| {
        let open = if given && miss.abs() > noise { d.left_open(measured) } else { 0.0 };
        let beyond = if miss.is_finite() { (miss.abs() - open).max(0.0) } else { 0.0 };
        let fine = beyond <= allowed;
        worst.set(worst.get().max(beyond));
        let by = miss.abs() * d.scales.length();
        match d.mechanism.statement_of(pin) {
            _ if fine => Ok(()),
            Some(_) => Err(DrawError::Unplaced { point: pin, why: Unplaced::Beside { by } }),
            None => Err(DrawError::NoClosure { pin, least: by }),
        }
    };
    for point in (0..d.places.len()).map(PointId) {
        if let (Some(at), Some(given)) = (d.places[point.0], d.world_place(point)) {
            let off = d.board.distance(given, at);
            missed(point, off.value(), &[off.mark()], d)?;
        }
    }
    stated_hints(d)?;
    for link in d.mechanism.moving() {
        let stands = |p: &PointId| d.places[p.0].is_some();
        let points: Vec<PointId> = d.mechanism.link(link).points.iter().copied().filter(stands).collect();
        for (index, &from) in points.iter().take(2).enumerate() {
            for &to in &points[index + 1..] {
                let (own_from, own_to) = (d.own(link, from), d.own(link, to));
                let own = d.board.distance(own_from, own_to);
                let (at_from, at_to) = (d.at(from), d.at(to));
                let drawn = d.board.distance(at_from, at_to);
                missed(to, drawn.value() - own.value(), &[drawn.mark(), own.mark()], d)?;
            }
        }
    }
    for index in 0..d.mechanism.slides.len() {
        let slide = d.mechanism.slides[index];
        if !stands(d, slide.guide.link) {
            continue;
        }
        turned_round(d, index)?;
        // Every point of a link that slides without turning moves on a parallel to the guide.
        let riders = match slide.rider {
            Rider::Pin { point, .. } => vec![point],
            Rider::Link { link, .. } => d.mechanism.link(link).points.clone(),
        };
        let way = d.mechanism.inputs.iter().find_map(|input| match *input {
            Input::Slide { slide, at: Some(at), .. } if slide == index => Some(at.value / d.scales.length()),
            Input::Slide { .. } | Input::Angle { .. } | Input::Speed { .. } => None,
        });
        for (order, point) in riders.into_iter().enumerate() {
            if d.places[point.0].is_none() {
                continue;
            }
            let at = d.at(point);
            match d.track(index, Some(point)) {
                Track::Straight(line) => {
                    let [along, across] = d.board.square_off(line, at);
                    missed(point, across.value(), &[across.mark()], d)?;
                    if let (Some(way), 0) = (way, order) {
                        missed(point, along.value() - way, &[along.mark()], d)?;
                    }
                }
                Track::Arc(arc) => {
                    let away = d.board.distance(arc.centre, at);
                    let miss = away.value() - arc.radius.value();
                    missed(point, miss, &[away.mark(), arc.radius.mark()], d)?;
                }
            }
        }
    }
    for roll in &d.mechanism.rolls {
        match *roll {
            Roll::Circles { centres, radii, internal, .. } => {
                if centres.iter().any(|c| d.places[c.0].is_none()) {
                    continue;
                }
                let [a, b] = centres.map(|c| d.at(c));
                let [r, s] = radii.map(|radius| radius.value / d.scales.length());
                let apart = if internal { (r - s).abs() } else { r + s };
                let away = d.board.distance(a, b);
                missed(centres[1], away.value() - apart, &[away.mark()], d)?;
            }
            Roll::Line { guide, centre, radius, .. } => {
                if d.places[centre.0].is_none() || !stands(d, guide.link) {
                    continue;
                }
                let Line { through, along } = d.line_of(&guide);
                let at = d.at(centre);
                let across = d.board.square_off(Line { through, along }, at)[1];
                let miss = across.value().abs() - radius.value / d.scales.length();
                missed(centre, miss, &[across.mark()], d)?;
            }
        }
    }
    let worst = worst.get();
    Ok(if worst > noise { worst * d.scales.length() } else { 0.0 })
}

/// Refuses a motion that takes bodies apart that roll on each other. Where a pair holds their centres, or the contact does
/// so itself, nothing can; any other distance is held by special dimensions at most, and only the motion tells.
///
/// # Errors
/// [`DrawError::ComesApart`] for the first pair in the order of the velocity diagram.
pub(super) fn contacts(d: &mut Draughtsman<'_>, plan: &Plan) -> Result<(), DrawError> {
    let held = d.structure.contacts();
    let steps = plan.steps(Order::Velocity).iter().map(|step| step.group);
    let joints = steps.flat_map(|group| &d.structure.groups[group].joints);
    let rolls = joints.filter_map(|joint| if let Joint::Roll(roll) = *joint { Some(roll) } else { None });
    let open = |roll: &usize| !held.contains(roll) && !holds_distance(d.mechanism, &d.mechanism.rolls[*roll]);
    let rolls: Vec<usize> = rolls.filter(open).collect();
    d.board.tape().aside(true);
    let apart = rolls.into_iter().find_map(|roll| d.parting(roll).map(|how| (roll, how)));
    d.board.tape().aside(false);
    apart.map_or(Ok(()), |(roll, how)| Err(DrawError::ComesApart { roll, how }))
}

impl Draughtsman<'_> {
    /// How a rolling pair comes apart, if it does by more than rounded places explain and than the bounds leave open.
    fn parting(&mut self, roll: usize) -> Option<Parting> {
        let (ends, line) = match self.mechanism.rolls[roll] {
            Roll::Circles { centres, .. } => (centres, None),
            Roll::Line { guide, centre, .. } => ([self.contact_of(roll), centre], Some(guide.link)),
        };
        let [from, to] = ends.map(|point| self.places[point.0]);
        let (from, to) = (from?, to?);
        let reason = self.reason(&self.mechanism.rolls[roll].bodies());
        let (along, length) = self.board.toward(from, to, reason);
        let velocity = self.apart(Order::Velocity, ends, line, along)?;
        if velocity.parts() {
            return Some(Parting::Speed(velocity.along));
        }
        // On a line that turns the contact wanders with the wheel: there velocities alone are looked at.
        if line.is_some_and(|link| link != LinkId::FRAME) {
            return None;
        }
        let mut acceleration = self.apart(Order::Acceleration, ends, line, along)?;
        if line.is_none() {
            // The distance d grows by n·A + V²/d, V being square to the line of centres.
            let length = length.value() * self.scales.length();
            let normal = velocity.across * velocity.across / length;
            acceleration.along += normal;
            acceleration.size += normal;
            acceleration.bound += 2.0 * velocity.across.abs() * velocity.bound / length;
        }
        acceleration.parts().then_some(Parting::Acceleration(acceleration.along))
    }

    /// How the second of two points moves against the first, of a line's body where one is named, along a direction and
    /// across it; `None` where no image of either is drawn.
    fn apart(
        &mut self,
        order: Order,
        [from, to]: [PointId; 2],
        line: Option<LinkId>,
        along: Direction,
    ) -> Option<Apart> {
        let [from, to] = [(from, line), (to, None)].map(|(point, link)| match link {
            Some(link) if link != LinkId::FRAME => self.image_drawn_under(order, point, link),
            Some(_) => Some(self.board.origin()),
            None if self.mechanism.is_fixed(point) => Some(self.board.origin()),
            None => self.images(order)[point.0],
        });
        let (from, to) = (from?, to?);
        let scale = self.polygon_scale(order).si_per_mm;
        let [towards, across] = self.board.square_off(Line { through: from, along }, to);
        let size =
            [from, to].iter().map(|image| libm::hypot(image.value()[0], image.value()[1])).sum::<f64>();
        let mut measured = Apart {
            along: towards.value() * scale,
            across: across.value() * scale,
            size: size * scale,
            bound: 0.0,
        };
        // What hangs on no determined motion tells nothing, and is told itself.
        let tape = self.board.tape();
        let marks = [towards.mark(), across.mark()];
        if marks.iter().any(|mark| tape.keeps() && tape.weakness(*mark).is_some()) {
            return None;
        }
        measured.bound = marks.iter().map(|mark| self.left_open(&[*mark])).sum::<f64>() * scale;
        Some(measured)
    }
}

/// A point's motion against another's.
struct Apart {
    along: f64,
    across: f64,
    /// The sum of the sizes that are compared.
    size: f64,
    bound: f64,
}

impl Apart {
    fn parts(&self) -> bool {
        self.along.abs() > (ROUNDING * self.size).max(self.bound)
    }
}

impl Draughtsman<'_> {
    /// By how much what was measured may be off for what is given, paper millimetres; nothing where no tape tells.
    pub(super) fn left_open(&mut self, measured: &[u32]) -> f64 {
        let tape = self.board.tape();
        if !tape.keeps() || measured.iter().any(|mark| tape.weakness(*mark).is_some()) {
            return 0.0;
        }
        measured.iter().map(|mark| tape.bound(*mark)).sum()
    }
}

/// What lies on a line either way round lies on it: which way it is turned shows by its direction alone.
///
/// # Errors
/// [`DrawError::TurnedRound`] where a link that slides is turned by half a turn against its guide, or a link of one joint
/// has what is driven along its guide behind it.
fn turned_round(d: &mut Draughtsman<'_>, slide: usize) -> Result<(), DrawError> {
    let pair = d.mechanism.slides[slide];
    // Beside its joint a rider may pass it; one that is driven stands where its input says.
    let behind = d.mechanism.inputs.iter().any(
        |input| matches!(*input, Input::Slide { slide: own, at: Some(at), .. } if own == slide && at.value < 0.0),
    );
    if behind && d.swivels_on(pair.guide.link, slide) && !d.faces_rider(pair.guide.link) {
        return Err(DrawError::TurnedRound { slide, how: Round::AwayFromRider });
    }
    // What does not stand is turned neither way.
    if let Rider::Link { link, turned: Some(_) } = pair.rider
        && let (Some(pose), Some(_)) = (d.poses[link.0], d.poses[pair.guide.link.0])
    {
        let (own, led) = d.ride_directions(slide, link);
        let stands = d.turned_with(own, pose.own_along, pose.along);
        let ([a, b], [x, y]) = (led.value(), stands.value());
        if a * x + b * y < 0.0 {
            return Err(DrawError::TurnedRound { slide, how: Round::Ride });
        }
    }
    Ok(())
}

/// A place that is stated of a point must agree with where the rest of the scene puts it.
fn stated_hints(d: &mut Draughtsman<'_>) -> Result<(), DrawError> {
    for index in 0..d.places.len() {
        if let (Some(stated), Some(at)) = (d.stated_hints[index], d.places[index]) {
            d.is_at(PointId(index), at, stated)?;
        }
    }
    Ok(())
}

/// Whether a link stands on the skeleton, so that its guides do.
fn stands(d: &Draughtsman<'_>, link: LinkId) -> bool {
    let points = &d.mechanism.link(link).points;
    let guides_by_points = points.iter().filter(|p| d.places[p.0].is_some()).count() > 1;
    d.stands_in_world(link) || d.poses[link.0].is_some() || guides_by_points
}
