//! Placed points: checked against guides and dimensions, then brought onto them.
//!
//! A placed point is read off a figure and misses what it must lie on by rounding. The dimension and
//! the guide hold: a point with one such locus is projected square onto it, a point with two follows
//! from them and its place is only a hint. A link dimensioned by placement, or driven without an angle,
//! needs exact places; its points go to the meeting point of their loci and stay placed.

use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::links::{index_of, own_coordinates};
use crate::mechanism::{
    Direction, Form, Given, GivenPoint, Guide, GuidePoint, Input, LinkId, Path, Place, PointId, Rider, Roll,
};

/// A figure's digits may miss by this part of the mechanism's size.
pub(super) const ROUNDING: f64 = 1e-6;
/// Loci that meet at a smaller angle (its sine) do not say where.
const GRAZING: f64 = 1e-4;
/// A link's pose is taken from, and checked against, this many of its points.
const ENOUGH: usize = 64;
/// Guides on links that ride on guides, and so on; deeper ones are not followed.
const DEEPEST: usize = 8;

type Xy = [f64; 2];

fn minus(a: Xy, b: Xy) -> Xy {
    [a[0] - b[0], a[1] - b[1]]
}

fn along(from: Xy, direction: Xy, distance: f64) -> Xy {
    [from[0] + direction[0] * distance, from[1] + direction[1] * distance]
}

fn length(a: Xy) -> f64 {
    libm::hypot(a[0], a[1])
}

fn dot(a: Xy, b: Xy) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn cross(a: Xy, b: Xy) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}

/// `a` turned by the angle of the unit vector `by`.
fn turn(a: Xy, by: Xy) -> Xy {
    [a[0] * by[0] - a[1] * by[1], a[0] * by[1] + a[1] * by[0]]
}

fn unit(a: Xy) -> Option<Xy> {
    let l = length(a);
    (l > 0.0).then(|| [a[0] / l, a[1] / l])
}

fn at_angle(radians: f64) -> Xy {
    let (sin, cos) = libm::sincos(radians);
    [cos, sin]
}

/// A known place.
#[derive(Debug, Clone, Copy)]
struct Spot {
    xy: Xy,
    error: f64,
}

/// Where a link lies: own coordinates are turned, then shifted.
#[derive(Debug, Clone, Copy)]
struct Pose {
    /// The place of the own point `anchor`.
    origin: Spot,
    anchor: Xy,
    turn: Xy,
    /// Error of the direction, radians.
    swing: f64,
}

impl Pose {
    const WORLD: Self =
        Self { origin: Spot { xy: [0.0; 2], error: 0.0 }, anchor: [0.0; 2], turn: [1.0, 0.0], swing: 0.0 };

    fn place(&self, own: Xy, error: f64) -> Spot {
        let arm = turn(minus(own, self.anchor), self.turn);
        let error = error + self.origin.error + self.swing * length(arm);
        Spot { xy: [self.origin.xy[0] + arm[0], self.origin.xy[1] + arm[1]], error }
    }
}

/// Where a point may lie.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Locus {
    Circle {
        centre: Xy,
        radius: f64,
    },
    Line {
        through: Xy,
        along: Xy,
    },
    Spot(Xy),
    /// It follows from the others, but not by one locus.
    Bound,
}

impl Locus {
    /// How far a place misses it, with the unit vector in which the miss grows.
    fn miss(&self, p: Xy) -> (f64, Xy) {
        match *self {
            Self::Circle { centre, radius } => {
                let arm = minus(p, centre);
                (length(arm) - radius, unit(arm).unwrap_or([1.0, 0.0]))
            }
            Self::Line { through, along } => {
                let left = [-along[1], along[0]];
                (dot(minus(p, through), left), left)
            }
            Self::Spot(spot) => {
                let miss = minus(p, spot);
                (length(miss), unit(miss).unwrap_or([1.0, 0.0]))
            }
            Self::Bound => (0.0, [1.0, 0.0]),
        }
    }
}

/// What binds a point to a locus.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Cause {
    Dimension { link: LinkId, other: PointId },
    Angle { link: LinkId, other: PointId },
    Guide { slide: usize },
    Along { slide: usize },
    Roll { roll: usize },
}

#[derive(Debug, Clone, Copy)]
struct Bond {
    cause: Cause,
    locus: Locus,
    error: f64,
}

/// Checks and settles all placed points.
pub(super) fn settle(draft: &mut Draft<'_>) -> Res<()> {
    let points = draft.mechanism.points.len();
    let placed: Vec<PointId> = (0..points)
        .map(PointId)
        .filter(|p| matches!(draft.mechanism.point(*p).place, Place::Placed(_)))
        .collect();
    if placed.is_empty() {
        return Ok(());
    }
    let board = Board::new(draft);
    for &point in &placed {
        board.check(point)?;
    }
    for (point, at, stands) in board.settle(&placed) {
        let place = if stands { Place::Placed(at) } else { Place::Near(at.map(|c| c.value)) };
        draft.mechanism.points[point.0].place = place;
        draft.settled.extend((!stands).then_some((point, at)));
    }
    Ok(())
}

/// The given points of a link that is dimensioned by placement lie along its input angle once they are settled; one of
/// the two must go.
pub(super) fn directed_by_places(draft: &mut Draft<'_>) {
    let links = &draft.mechanism.links;
    for input in &mut draft.mechanism.inputs {
        match input {
            Input::Angle { link, angle, .. } | Input::Speed { link, angle, .. }
                if links[link.0].form == Form::Placed =>
            {
                *angle = None;
            }
            _ => {}
        }
    }
}

/// Where a rider and the start of its straight guide are placed, they say where a driven slide stands: `at` must say the
/// same, and what differs by rounding is one fact, that of the places.
///
/// # Errors
/// A [`Fault`] that names both where they differ by more.
pub(super) fn along_by_places(draft: &mut Draft<'_>) -> Res<()> {
    let size = size(draft);
    for index in 0..draft.mechanism.inputs.len() {
        let Input::Slide { slide, at: Some(at), .. } = draft.mechanism.inputs[index] else { continue };
        let pair = draft.mechanism.slides[slide];
        let Path::Straight { through, offset, .. } = pair.guide.path else { continue };
        let Some(rider) = draft.riding_point(&pair.rider) else { continue };
        // On a guide of the frame `at` brings the rider to its place (see `Cause::Along`), unless dimensions hold it there.
        let framed = pair.guide.link == LinkId::FRAME;
        let links = &draft.mechanism.point(rider).links;
        let held = |link: &LinkId| {
            *link != LinkId::FRAME && !matches!(draft.link(*link).form, Form::Placed | Form::Single)
        };
        if framed && !links.iter().any(held) {
            continue;
        }
        let exact = |point: PointId| draft.mechanism.point(point).place.exact().map(spot_of);
        let (start, named) = match through {
            GuidePoint::Point(point) => (exact(point), Some(point)),
            GuidePoint::Own(at) if framed => (Some(spot_of(at)), None),
            GuidePoint::Own(_) => (None, None),
        };
        // A place with room follows from `at`, which is known better.
        let roomy = named.iter().chain([&rider]).any(|&point| draft.room(point) > 0.0);
        let (Some(to), Some(from), false) = (exact(rider), start, roomy) else { continue };
        let way = length(minus(to.xy, from.xy));
        let by_places = (way * way - offset.value * offset.value).max(0.0).sqrt();
        let miss = (by_places - at.value.abs()).abs();
        let known = at.error + to.error + from.error + offset.error;
        if miss > ROUNDING * size + known {
            let say = |metres| draft.scales.say_length(metres);
            let name = draft.say_point(rider);
            let first = named.map_or("its start", |point| draft.say_point(point));
            let what = format!(
                "{name} is placed {} along its guide from {first}, but `at` of the driven slides[{slide}] says {}",
                say(by_places),
                say(at.value.abs())
            );
            let mend = format!("correct one of the two; up to {} is taken as rounding", say(ROUNDING * size));
            return Err(Fault::new(draft.anchors.inputs[index], what).mend(mend));
        }
        if miss > known
            && let Input::Slide { at, .. } = &mut draft.mechanism.inputs[index]
        {
            *at = None;
        }
    }
    Ok(())
}

/// What is known while placed points are checked and settled.
struct Board<'b, 's> {
    draft: &'b Draft<'s>,
    /// Largest extent of known points and lengths, metres.
    size: f64,
    /// Known places: of fixed points, and of placed ones as far as they are settled (or all, while
    /// they are checked).
    spots: Vec<Option<Spot>>,
    /// Indices of the sliding pairs by the point that rides.
    rides: Vec<Vec<usize>>,
    /// Indices of the rolling pairs by centre.
    rolls: Vec<Vec<usize>>,
}

fn spot_of(place: [Given; 2]) -> Spot {
    Spot { xy: place.map(|c| c.value), error: place[0].error + place[1].error }
}

impl<'b, 's> Board<'b, 's> {
    fn new(draft: &'b Draft<'s>) -> Self {
        let mechanism = &draft.mechanism;
        let mut rides = vec![Vec::new(); mechanism.points.len()];
        for (index, slide) in mechanism.slides.iter().enumerate() {
            if let Some(point) = draft.riding_point(&slide.rider) {
                rides[point.0].push(index);
            }
        }
        let mut rolls = vec![Vec::new(); mechanism.points.len()];
        for (index, roll) in mechanism.rolls.iter().enumerate() {
            match roll {
                Roll::Circles { centres, .. } => centres.iter().for_each(|c| rolls[c.0].push(index)),
                Roll::Line { centre, .. } => rolls[centre.0].push(index),
            }
        }
        let spots = mechanism.points.iter().map(|p| match p.place {
            Place::Fixed(at) => Some(spot_of(at)),
            _ => None,
        });
        let mut board = Self { draft, size: size(draft), spots: spots.collect(), rides, rolls };
        board.derive();
        for (spot, point) in board.spots.iter_mut().zip(&mechanism.points) {
            *spot = point.place.exact().map(spot_of).or(*spot);
        }
        board.keep_rooms();
        board
    }

    /// Finds what the inputs alone place: the points of a link that is driven by its angle about a known point, the
    /// rider of a driven slide, and what rides on them.
    fn derive(&mut self) {
        let mechanism = &self.draft.mechanism;
        for _ in 0..DEEPEST {
            let mut found: Vec<(PointId, Spot)> = Vec::new();
            for input in &mechanism.inputs {
                let Input::Slide { slide, at: Some(at), .. } = input else { continue };
                let pair = &mechanism.slides[*slide];
                if let (Some(point), Some((Locus::Line { along: line, .. }, error, origin))) =
                    (self.draft.riding_point(&pair.rider), self.guide(&pair.guide, 0))
                {
                    found.push((point, Spot { xy: along(origin, line, at.value), error: error + at.error }));
                }
            }
            for link in mechanism.moving() {
                if matches!(self.form(link), Form::Placed | Form::Single) {
                    continue;
                }
                let Some(pose) = self.pose(link, None, 0) else { continue };
                for &point in &self.draft.link(link).points {
                    found.extend(self.own(link, point).map(|(own, error)| (point, pose.place(own, error))));
                }
            }
            found.retain(|(point, _)| self.spots[point.0].is_none());
            if found.is_empty() {
                return;
            }
            for (point, spot) in found {
                self.spots[point.0].get_or_insert(spot);
            }
        }
    }

    /// A stated room is a radius: it is not counted once for each coordinate.
    fn keep_rooms(&mut self) {
        for (index, spot) in self.spots.iter_mut().enumerate() {
            let room = self.draft.room(PointId(index));
            if let (Some(spot), true) = (spot.as_mut(), room > 0.0) {
                spot.error = (spot.error - room).max(room);
            }
        }
    }

    fn spot(&self, point: PointId) -> Option<Spot> {
        self.spots[point.0]
    }

    fn form(&self, link: LinkId) -> &Form {
        &self.draft.link(link).form
    }

    /// A point's own coordinates in a link with dimensions of its own.
    fn own(&self, link: LinkId, point: PointId) -> Option<(Xy, f64)> {
        own_coordinates(self.draft.link(link), index_of(self.draft, link, point)?)
    }

    /// The known points of a link with their own coordinates, `but` one.
    fn known(&self, link: LinkId, but: Option<PointId>) -> Vec<(PointId, Spot, Xy, f64)> {
        let points = self.draft.link(link).points.iter().enumerate();
        points
            .filter(|(_, p)| Some(**p) != but)
            .filter_map(|(index, &p)| {
                let (own, error) = own_coordinates(self.draft.link(link), index)?;
                Some((p, self.spot(p)?, own, error))
            })
            .take(ENOUGH)
            .collect()
    }

    /// Own direction from the first joint to the second; the own x-axis where there is one joint.
    fn own_line(&self, link: LinkId) -> Option<Xy> {
        if *self.form(link) == Form::Single {
            return Some([1.0, 0.0]);
        }
        let (first, _) = own_coordinates(self.draft.link(link), 0)?;
        let (second, _) = own_coordinates(self.draft.link(link), 1)?;
        unit(minus(second, first))
    }

    /// The direction in which a link's own x-axis is turned by its input or by the guide on which it
    /// rides, with its error.
    fn turned(&self, link: LinkId, depth: usize) -> Option<(Xy, f64)> {
        if let Some(angle) = self.draft.input_angle(link) {
            let line = self.own_line(link)?;
            return Some((turn(at_angle(angle.value), [line[0], -line[1]]), angle.error));
        }
        let slides = &self.draft.mechanism.slides;
        let ride = slides.iter().find_map(|slide| match slide.rider {
            Rider::Link { link: rider, turned: Some(turned) } if rider == link => Some((slide.guide, turned)),
            _ => None,
        });
        if let Some((guide, turned)) = ride {
            let (locus, error, _) = self.guide(&guide, depth + 1)?;
            let Locus::Line { along, .. } = locus else { return None };
            return Some((turn(along, at_angle(turned.value)), turned.error + error / self.size.max(1e-300)));
        }
        if *self.form(link) != Form::Single {
            return None;
        }
        // A swivelling guide turns toward its rider; any other one-joint link has the world's axes.
        let own_joint = |guide: &Guide| match guide.path {
            Path::Straight { through: GuidePoint::Point(_), .. } => true,
            Path::Straight { through: GuidePoint::Own(place), .. } => place.map(|c| c.value) == [0.0, 0.0],
            Path::Arc { .. } => false,
        };
        let carries = slides.iter().any(|slide| slide.guide.link == link && own_joint(&slide.guide));
        let swivels = carries && !self.draft.link(link).block;
        (!swivels).then_some(([1.0, 0.0], 0.0))
    }

    /// Where a link lies, as far as the known points, its input and its ride say. `but`: a point that
    /// must not be asked.
    fn pose(&self, link: LinkId, but: Option<PointId>, depth: usize) -> Option<Pose> {
        if depth > DEEPEST {
            return None;
        }
        if *self.form(link) == Form::Placed {
            return Some(Pose::WORLD);
        }
        let known = self.known(link, but);
        let &(_, origin, anchor, anchor_error) = known.first()?;
        let far =
            known.iter().max_by(|a, b| length(minus(a.2, anchor)).total_cmp(&length(minus(b.2, anchor))));
        let origin = Spot { error: origin.error + anchor_error, ..origin };
        if let Some((_, spot, own, error)) = far {
            let (own, seen) = (minus(*own, anchor), minus(spot.xy, origin.xy));
            if let (Some(own_line), Some(line)) = (unit(own), unit(seen)) {
                let swing = (origin.error + spot.error + error) / length(seen);
                return Some(Pose { origin, anchor, turn: turn(line, [own_line[0], -own_line[1]]), swing });
            }
        }
        let (turn, swing) = self.turned(link, depth)?;
        Some(Pose { origin, anchor, turn, swing })
    }

    /// A point of a guide in the world.
    fn guide_point(&self, link: LinkId, pose: &Pose, point: GuidePoint) -> Option<Spot> {
        match point {
            GuidePoint::Own(place) => {
                let own = spot_of(place);
                Some(pose.place(own.xy, own.error))
            }
            GuidePoint::Point(point) if *self.form(link) == Form::Placed => self.spot(point),
            GuidePoint::Point(point) => {
                let (own, error) = self.own(link, point)?;
                Some(pose.place(own, error))
            }
        }
    }

    /// A guide in the world: its locus, its error, and where `at` counts from.
    fn guide(&self, guide: &Guide, depth: usize) -> Option<(Locus, f64, Xy)> {
        let pose = self.pose(guide.link, None, depth)?;
        match guide.path {
            Path::Arc { centre, radius } => {
                let centre = self.guide_point(guide.link, &pose, centre)?;
                let locus = Locus::Circle { centre: centre.xy, radius: radius.value };
                Some((locus, centre.error + radius.error, centre.xy))
            }
            Path::Straight { through, direction, turned, offset } => {
                let through = self.guide_point(guide.link, &pose, through)?;
                let (line, swing) = match direction {
                    Direction::Angle(angle) => {
                        (turn(pose.turn, at_angle(angle.value)), pose.swing + angle.error)
                    }
                    Direction::Toward(point) => {
                        let toward = self.guide_point(guide.link, &pose, GuidePoint::Point(point))?;
                        let line = minus(toward.xy, through.xy);
                        (unit(line)?, (through.error + toward.error) / length(line))
                    }
                };
                let line = turn(line, at_angle(turned.value));
                let origin = along(through.xy, [-line[1], line[0]], offset.value);
                let error = through.error + offset.error + (swing + turned.error) * self.size;
                Some((Locus::Line { through: origin, along: line }, error, origin))
            }
        }
    }

    /// What binds a point through one of its links, while the other points are settled.
    fn link_bonds(&self, point: PointId, link: LinkId, bonds: &mut Vec<Bond>) {
        let Some((own, own_error)) = self.own(link, point) else { return };
        let known = self.known(link, Some(point));
        let Some(&(other, spot, other_own, other_error)) = known.first() else { return };
        let distance = length(minus(own, other_own));
        let error = spot.error + own_error + other_error;
        let cause = Cause::Dimension { link, other };
        if distance == 0.0 {
            bonds.push(Bond { cause, locus: Locus::Spot(spot.xy), error });
        } else if let Some(pose) = self.pose(link, Some(point), 0) {
            let place = pose.place(own, own_error);
            bonds.push(Bond { cause, locus: Locus::Spot(place.xy), error: place.error });
        } else {
            bonds.push(Bond { cause, locus: Locus::Circle { centre: spot.xy, radius: distance }, error });
            // A known pin on a guide of this link holds its direction.
            let slides = self.draft.mechanism.slides.iter();
            let held = slides
                .filter(|slide| slide.guide.link == link)
                .any(|slide| matches!(slide.rider, Rider::Pin { point, .. } if self.spot(point).is_some()));
            if held {
                bonds.push(Bond { cause, locus: Locus::Bound, error });
            }
        }
    }

    /// The dimensions of a link that a place can contradict: its distance to every other known point,
    /// and its direction where the input gives one.
    fn link_claims(&self, point: PointId, link: LinkId, claims: &mut Vec<Bond>) {
        let Some((own, own_error)) = self.own(link, point) else { return };
        let known = self.known(link, Some(point));
        for &(other, spot, other_own, other_error) in &known {
            let radius = length(minus(own, other_own));
            let locus = match radius {
                0.0 => Locus::Spot(spot.xy),
                _ => Locus::Circle { centre: spot.xy, radius },
            };
            let error = spot.error + own_error + other_error;
            claims.push(Bond { cause: Cause::Dimension { link, other }, locus, error });
        }
        if let (Some(&(other, spot, anchor, error)), Some(angle), Some(line)) =
            (known.first(), self.draft.input_angle(link), self.own_line(link))
        {
            let turn = turn(at_angle(angle.value), [line[0], -line[1]]);
            let place = Pose { origin: spot, anchor, turn, swing: angle.error }.place(own, own_error + error);
            let cause = Cause::Angle { link, other };
            claims.push(Bond { cause, locus: Locus::Spot(place.xy), error: place.error });
        }
    }

    /// The line on which the input angle keeps the first two joints of a link dimensioned by placement.
    fn angle_bond(&self, point: PointId, link: LinkId) -> Option<(Bond, f64)> {
        let angle = self.draft.input_angle(link)?;
        let (other, sign) = match self.draft.link(link).points.as_slice() {
            [first, second, ..] if *first == point => (*second, -1.0),
            [first, second, ..] if *second == point => (*first, 1.0),
            _ => return None,
        };
        let spot = self.spot(other)?;
        let locus = Locus::Line { through: spot.xy, along: at_angle(angle.value) };
        let error = spot.error + angle.error * self.size;
        Some((Bond { cause: Cause::Angle { link, other }, locus, error }, sign))
    }

    /// The sliding and rolling pairs that bind a point.
    fn pair_bonds(&self, point: PointId, checking: bool, bonds: &mut Vec<Bond>) {
        let slides = &self.draft.mechanism.slides;
        for &slide in &self.rides[point.0] {
            let Some((locus, error, origin)) = self.guide(&slides[slide].guide, 0) else { continue };
            let at = self.draft.mechanism.inputs.iter().find_map(|input| match input {
                Input::Slide { slide: driven, at, .. } if *driven == slide => *at,
                _ => None,
            });
            let spot = match (locus, at) {
                (Locus::Line { along: line, .. }, Some(at)) => {
                    Some((along(origin, line, at.value), at.error))
                }
                _ => None,
            };
            if spot.is_none() || checking {
                bonds.push(Bond { cause: Cause::Guide { slide }, locus, error });
            }
            if let Some((spot, more)) = spot {
                let cause = Cause::Along { slide };
                bonds.push(Bond { cause, locus: Locus::Spot(spot), error: error + more });
            }
        }
        for &roll in &self.rolls[point.0] {
            if let Some((locus, error)) = self.contact(point, &self.draft.mechanism.rolls[roll]) {
                bonds.push(Bond { cause: Cause::Roll { roll }, locus, error });
            }
        }
    }

    /// Where contact keeps a wheel's centre, unless something else holds the distance.
    fn contact(&self, point: PointId, roll: &Roll) -> Option<(Locus, f64)> {
        match roll {
            Roll::Circles { centres, radii, internal, .. } => {
                let other = if centres[0] == point { centres[1] } else { centres[0] };
                let links = &self.draft.mechanism.point(point).links;
                // A link whose own dimensions follow from the places gives way to the radii.
                let follows =
                    |link: LinkId| link != LinkId::FRAME && self.draft.link(link).form == Form::Placed;
                if links.iter().any(|link| self.draft.stands_in(other, *link) && !follows(*link)) {
                    return None;
                }
                let spot = self.spot(other)?;
                let [a, b] = radii.map(|r| r.value);
                let radius = if *internal { (a - b).abs() } else { a + b };
                let error = spot.error + radii[0].error + radii[1].error;
                Some((Locus::Circle { centre: spot.xy, radius }, error))
            }
            Roll::Line { guide, radius, .. } => {
                let slides = &self.draft.mechanism.slides;
                if self.rides[point.0].iter().any(|s| slides[*s].guide.link == guide.link) {
                    return None;
                }
                let (locus, error, _) = self.guide(guide, 0)?;
                let Locus::Line { through, along: line } = locus else { return None };
                let hint = self.draft.mechanism.point(point).place.hint()?;
                let (side, left) = locus.miss(hint);
                let shift = if side < 0.0 { -radius.value } else { radius.value };
                let through = along(through, left, shift);
                Some((Locus::Line { through, along: line }, error + radius.error))
            }
        }
    }

    /// Whether a placed point contradicts a dimension, an angle or a guide.
    fn check(&self, point: PointId) -> Res<()> {
        let Some(spot) = self.spot(point) else { return Ok(()) };
        let tolerance = ROUNDING * self.size;
        let mut claims = Vec::new();
        for &link in &self.draft.mechanism.point(point).links {
            if let Some((claim, sign)) = self.angle_bond(point, link)
                && let Locus::Line { through, along: line } = claim.locus
            {
                let opposite = dot(minus(spot.xy, through), line) * sign <= 0.0;
                if opposite || claim.locus.miss(spot.xy).0.abs() > tolerance + claim.error + spot.error {
                    return Err(self.contradiction(point, spot.xy, &claim, tolerance));
                }
            }
            if link != LinkId::FRAME && *self.form(link) != Form::Single {
                self.link_claims(point, link, &mut claims);
                self.check_sense(point, link, tolerance)?;
            }
        }
        self.pair_bonds(point, true, &mut claims);
        match claims.iter().find(|c| c.locus.miss(spot.xy).0.abs() > tolerance + c.error + spot.error) {
            Some(claim) => Err(self.contradiction(point, spot.xy, claim, tolerance)),
            None => Ok(()),
        }
    }

    /// Whether a link's points are placed as its mirror image.
    fn check_sense(&self, point: PointId, link: LinkId, tolerance: f64) -> Res<()> {
        let (Some(spot), Some((own, _))) = (self.spot(point), self.own(link, point)) else { return Ok(()) };
        let known = self.known(link, Some(point));
        let Some(&(first, origin, anchor, _)) = known.first() else { return Ok(()) };
        for &(second, other, other_own, _) in &known[1..] {
            let stated = cross(minus(other_own, anchor), minus(own, anchor));
            let seen = cross(minus(other.xy, origin.xy), minus(spot.xy, origin.xy));
            // Twice the area against the longest side: the height by which the triangle is not flat.
            let flat = self.size * (tolerance + origin.error + other.error + spot.error);
            if stated * seen < 0.0 && stated.abs() > flat && seen.abs() > flat {
                let what = format!(
                    "{}, {} and {} are placed as the mirror image of {}",
                    self.draft.say_point(first),
                    self.draft.say_point(second),
                    self.draft.say_point(point),
                    self.draft.say(link)
                );
                return Err(Fault::new(self.draft.anchors.place(point), what)
                    .mend("correct the places, or the link's turning sense"));
            }
        }
        Ok(())
    }

    /// That a point is placed where something else says that it is not.
    fn contradiction(&self, point: PointId, seen: Xy, claim: &Bond, tolerance: f64) -> Fault {
        let name = self.draft.say_point(point);
        let say = |metres| self.draft.scales.say_length(metres);
        let miss = claim.locus.miss(seen).0.abs();
        let distance = |locus: &Locus| match locus {
            Locus::Circle { centre, radius } => (length(minus(seen, *centre)), *radius),
            _ => (miss, 0.0),
        };
        let what = match claim.cause {
            Cause::Dimension { link, other } => {
                let (found, stated) = distance(&claim.locus);
                let (other, link) = (self.draft.say_point(other), self.draft.say(link));
                format!("{name} is placed {} from {other}, but {link} makes it {}", say(found), say(stated))
            }
            Cause::Angle { link, other } => {
                let from = self.spot(other).map_or([0.0; 2], |spot| spot.xy);
                let mut arm = minus(seen, from);
                let points = &self.draft.link(link).points;
                let mut ends = (self.draft.say_point(other), name);
                if points.first() == Some(&point) {
                    arm = minus(from, seen);
                    ends = (name, self.draft.say_point(other));
                }
                let angle = libm::atan2(arm[1], arm[0]);
                let stated = self.draft.input_angle(link).map_or(0.0, |a| a.value);
                let [angle, stated] = [angle, stated].map(|a| self.draft.scales.say_angle(a));
                let (from, to) = ends;
                let line = format!("the line from {from} to {to} is placed at {angle}");
                if points.iter().take(2).all(|p| [point, other].contains(p)) {
                    format!("{line}, but the input gives {} {stated}", self.draft.say(link))
                } else {
                    format!(
                        "{name} is placed {} beside where the input angle {stated} of {} puts it",
                        say(miss),
                        self.draft.say(link)
                    )
                }
            }
            Cause::Guide { slide } => {
                let guide = self.draft.mechanism.slides[slide].guide.link;
                format!(
                    "{name} is placed {} beside its guide on {} (slides[{slide}])",
                    say(miss),
                    self.draft.say(guide)
                )
            }
            Cause::Along { slide } => {
                format!(
                    "{name} is placed {} from where `at` of the driven slides[{slide}] puts it",
                    say(miss)
                )
            }
            Cause::Roll { roll } => {
                let (found, stated) = match &self.draft.mechanism.rolls[roll] {
                    Roll::Line { radius, .. } => {
                        (radius.value + claim.locus.miss(seen).0.abs(), radius.value)
                    }
                    Roll::Circles { .. } => distance(&claim.locus),
                };
                let (found, stated) = (say(found), say(stated));
                format!(
                    "{name} is placed {found} from what it rolls on, but the radii of rolls[{roll}] make it {stated}"
                )
            }
        };
        Fault::new(self.draft.anchors.place(point), what)
            .mend(match self.draft.room(point) {
                0.0 => format!(
                    "correct one of the two; up to {} is taken as rounding; a place read off a figure may state its room: {{\"at\": [x, y], \"within\": …}}",
                    say(tolerance)
                ),
                room => format!("correct one of the two, or the room of {} that is stated for {name}", say(room)),
            })
    }

    /// Whether a point's exact place is needed whatever binds it, and whether an input needs it.
    fn needed(&self, point: PointId) -> (bool, bool) {
        let links = &self.draft.mechanism.point(point).links;
        let of_placed_link = links.iter().any(|l| *l != LinkId::FRAME && *self.form(*l) == Form::Placed);
        let of_input = self.draft.mechanism.inputs.iter().any(|input| match input {
            Input::Angle { link, angle: None, .. } | Input::Speed { link, angle: None, .. } => {
                // A driven link of one joint stands by what rides on it.
                let slides = &self.draft.mechanism.slides;
                let rides = || self.rides[point.0].iter().any(|slide| slides[*slide].guide.link == *link);
                links.contains(link) || *self.form(*link) == Form::Single && rides()
            }
            Input::Slide { slide, at: None, .. } => self.rides[point.0].contains(slide),
            _ => false,
        });
        (of_placed_link || of_input, of_input)
    }

    /// Settles the placed points one after the other: those that carry moving guides before those that
    /// ride on them, and those of the inputs before the rest, so that the drive stays exact. Each with its place, and whether
    /// it is given by that, or follows from the rest of the scene.
    fn settle(mut self, placed: &[PointId]) -> Vec<(PointId, GivenPoint, bool)> {
        let slides = &self.draft.mechanism.slides;
        let mut order: Vec<PointId> = placed.to_vec();
        order.sort_by_key(|&p| {
            let rides = self.rides[p.0].iter().any(|s| slides[*s].guide.link != LinkId::FRAME);
            (rides, !self.needed(p).1, p)
        });
        let raw: Vec<Option<Spot>> = self.spots.clone();
        for &point in placed {
            self.spots[point.0] = None;
        }
        let mut places = Vec::with_capacity(order.len());
        for point in order {
            let Some(spot) = raw[point.0] else { continue };
            let (needed, _) = self.needed(point);
            let mut bonds = Vec::new();
            for &link in &self.draft.mechanism.point(point).links {
                match self.angle_bond(point, link) {
                    Some((bond, _)) if *self.form(link) == Form::Placed => bonds.push(bond),
                    _ if *self.form(link) != Form::Single => self.link_bonds(point, link, &mut bonds),
                    _ => {}
                }
            }
            self.pair_bonds(point, false, &mut bonds);
            if bonds.is_empty() {
                // Nothing to bring it onto: it keeps its digits.
                self.spots[point.0] = Some(spot);
                continue;
            }
            let (settled, free) = self.meet(spot, &bonds);
            self.spots[point.0] = Some(settled);
            let at = settled.xy.map(|value| Given::within(value, settled.error));
            places.push((point, at, free || needed));
        }
        places
    }

    /// Brings a place onto the loci that bind it; whether it is still free to lie elsewhere on them.
    fn meet(&self, spot: Spot, bonds: &[Bond]) -> (Spot, bool) {
        let mut loci: Vec<&Bond> = Vec::new();
        for bond in bonds {
            if !loci.iter().any(|other| other.locus == bond.locus) {
                loci.push(bond);
            }
        }
        let reach = spot.xy[0].abs().max(spot.xy[1].abs()).max(self.size);
        let rounding = 8.0 * f64::EPSILON * reach;
        if let Some(bond) = loci.iter().find(|b| matches!(b.locus, Locus::Spot(_))) {
            let Locus::Spot(xy) = bond.locus else { return (spot, false) };
            return (Spot { xy, error: bond.error + rounding }, false);
        }
        let held = loci.iter().any(|b| b.locus == Locus::Bound);
        loci.retain(|b| b.locus != Locus::Bound);
        let Some(&first) = loci.first() else { return (spot, !held) };
        // The partner that crosses the first locus most squarely.
        let normal = first.locus.miss(spot.xy).1;
        let crossing = |b: &Bond| cross(normal, b.locus.miss(spot.xy).1).abs();
        let partner = loci[1..].iter().copied().max_by(|a, b| crossing(a).total_cmp(&crossing(b)));
        let sine = partner.map_or(0.0, &crossing);
        let mut xy = spot.xy;
        match partner {
            Some(second) if sine > GRAZING => {
                for _ in 0..8 {
                    xy = step(xy, &first.locus, &second.locus);
                }
                let error = (first.error + second.error + rounding) / sine;
                (Spot { xy, error }, false)
            }
            _ => {
                for _ in 0..2 {
                    let (miss, normal) = first.locus.miss(xy);
                    xy = along(xy, normal, -miss);
                }
                let error = spot.error + first.error + rounding;
                // Loci that only touch, or are one (a wheel's circle and its arm), do not say where on them it lies.
                (Spot { xy, error }, !held)
            }
        }
    }
}

/// One step of Newton toward the meeting point of two loci.
fn step(xy: Xy, first: &Locus, second: &Locus) -> Xy {
    let (a, n) = first.miss(xy);
    let (b, m) = second.miss(xy);
    let determinant = cross(n, m);
    if determinant.abs() < GRAZING / 2.0 {
        return xy;
    }
    let dx = (a * m[1] - b * n[1]) / determinant;
    let dy = (n[0] * b - m[0] * a) / determinant;
    [xy[0] - dx, xy[1] - dy]
}

/// The largest extent of the known points and of the given lengths, metres.
pub(super) fn size(draft: &Draft<'_>) -> f64 {
    let mechanism = &draft.mechanism;
    let mut low = [f64::INFINITY; 2];
    let mut high = [f64::NEG_INFINITY; 2];
    for place in mechanism.points.iter().filter_map(|p| p.place.exact()) {
        for axis in 0..2 {
            low[axis] = low[axis].min(place[axis].value);
            high[axis] = high[axis].max(place[axis].value);
        }
    }
    let mut size = if low[0] <= high[0] { length(minus(high, low)) } else { 0.0 };
    for link in &mechanism.links {
        let own = (0..link.points.len()).filter_map(|i| own_coordinates(link, i));
        let first = own_coordinates(link, 0).map(|(place, _)| place);
        for (place, _) in own {
            size = size.max(first.map_or(0.0, |first| length(minus(place, first))));
        }
    }
    for slide in &mechanism.slides {
        size = size.max(match slide.guide.path {
            Path::Arc { radius, .. } => radius.value,
            Path::Straight { offset, .. } => offset.value.abs(),
        });
    }
    for roll in &mechanism.rolls {
        size = size.max(match roll {
            Roll::Circles { radii, .. } => radii[0].value.max(radii[1].value),
            Roll::Line { radius, .. } => radius.value,
        });
    }
    for input in &mechanism.inputs {
        if let Input::Slide { at: Some(at), .. } = input {
            size = size.max(at.value.abs());
        }
    }
    if size > 0.0 {
        return size;
    }
    // One placed point and nothing else with a length: its coordinates, as its digits have them, and those of the
    // guides of the frame. (A guide may be given by a point of it that is far away, so these come last.)
    let on_guides = mechanism.slides.iter().filter_map(|slide| match (slide.guide.link, slide.guide.path) {
        (LinkId::FRAME, Path::Straight { through: GuidePoint::Own(at), .. }) => Some(at),
        (LinkId::FRAME, Path::Arc { centre: GuidePoint::Own(at), .. }) => Some(at),
        _ => None,
    });
    let places = mechanism.points.iter().filter_map(|p| p.place.exact()).chain(on_guides);
    places.flatten().map(|c| c.value.abs()).fold(0.0, f64::max)
}
