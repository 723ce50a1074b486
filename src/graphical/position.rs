//! The kinematic skeleton, by protractor, compass and guide (`s000-ch3a` 2.3: choose a length scale; draw;
//! measure any missing length on it).

use crate::board::{Angle, Circle, Direction, Line, Pair, Point, Side};
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::{Drive, Group, GroupKind, Hold, Ram, TrialDriver};
use crate::mechanism::{Form, GuidePoint, Input, LinkId, Path, PointId, Rider, Roll};
use crate::plan::{GroupStep, Plan};

use super::construction::{Act, Claim, ConstructionLine, Reference};
use super::draughtsman::Draughtsman;
use super::draughtsman::Skeleton;
use super::figure;
use super::missing::Missing;
use super::pose::{DEEPEST, Pose, Track};
use super::{DrawError, Misfit};

/// Where the skeleton's own frame begins: the first fixed point, else the first placed one, of those by which anything is
/// held.
pub(super) fn origin_of_space(mechanism: &crate::mechanism::Mechanism) -> [Given; 2] {
    let leads = |point: PointId| {
        mechanism.slides.iter().any(|slide| match slide.guide.path {
            Path::Straight { through, direction, .. } => {
                through == GuidePoint::Point(point) || direction == crate::mechanism::Direction::Toward(point)
            }
            Path::Arc { .. } => true,
        })
    };
    let exact = |fixed: bool, held: bool| {
        let points = mechanism.points.iter().enumerate();
        let mut points = points
            .filter(|(_, p)| !fixed || matches!(p.place, crate::mechanism::Place::Fixed(_)))
            .filter(|(index, p)| {
                !held || p.links.iter().any(|link| *link != LinkId::FRAME) || leads(PointId(*index))
            });
        points.find_map(|(_, p)| p.place.exact())
    };
    let ways = [(true, true), (true, false), (false, false)];
    // Where nothing has a given place, one's own paper begins where one likes.
    ways.into_iter().find_map(|(fixed, held)| exact(fixed, held)).unwrap_or([Given::exact(0.0); 2])
}

/// Draws the steps of the skeleton.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) -> Result<(), DrawError> {
    d.step(Order::Position, &[], Vec::new());
    d.board.purpose("frame");
    for index in 0..d.mechanism.points.len() {
        if d.mechanism.is_fixed(PointId(index)) {
            d.prick_given(PointId(index));
        }
    }
    d.act(Act::MarkPlaces);
    figure::draw(d)?;
    let begun = d.skeleton();
    match draw_groups(d, plan) {
        // What is driven need not stand by its input, nor a group by its dyads: places may tell it from the other end.
        Err(
            error @ (DrawError::Missing(_)
            | DrawError::NotPlaced { .. }
            | DrawError::NoAngle { .. }
            | DrawError::NoClosure { .. }),
        ) => {
            d.back_to(&begun);
            let led = d.lead_by_places();
            let found = d.skeleton();
            d.back_to(&Skeleton { places: begun.places.clone(), poses: begun.poses.clone(), ..found });
            let mut drawn = if led { draw_groups(d, plan) } else { Err(error.clone()) };
            if drawn.is_err() {
                d.back_to(&begun);
                if d.lead_from_far_end() {
                    let found = d.skeleton();
                    d.back_to(&Skeleton { places: begun.places, poses: begun.poses, ..found });
                    drawn = draw_groups(d, plan);
                }
            }
            match error {
                // What does not close by its dyads is told as it was found by them.
                DrawError::NoClosure { .. } => drawn.map_err(|_| error),
                _ => drawn,
            }
        }
        drawn => drawn,
    }
}

/// Draws the planned groups in order of transmission.
pub(super) fn draw_groups(d: &mut Draughtsman<'_>, plan: &Plan) -> Result<(), DrawError> {
    for step in plan.steps(Order::Position) {
        let group = &d.structure.groups[step.group];
        d.step(Order::Position, &group.links.clone(), Vec::new());
        d.position_of(step, group)?;
    }
    Ok(())
}

/// Two hints that differ by less than this part cannot choose between two places.
const HINT_TIE: f64 = 1e-9;
/// A hint that is so many times farther away than two places lie apart does not lie between them: it is a mistake.
const HINT_FAR: f64 = 1e6;
/// Nor can two whose distances differ by less than this on paper, millimetres: rounding does.
const HINT_FLOOR: f64 = 1e-12;
/// A guide and an arc that cross at a smaller angle only touch, as far as a direction is read from it, radians.
pub(super) const TOUCHES: f64 = 1e-4;
/// A guide is square to its link's x-axis where the cosine of their angle is no more than this.
const SQUARE: f64 = 2e-6;

/// Whether a hint is missed by so much less in one way than in another that it chooses: squares of distances in
/// metres, at a scale of metres per millimetre.
pub(super) fn chooses(less: f64, more: f64, per_mm: f64) -> bool {
    more - less > HINT_TIE * (more + less) && more.sqrt() - less.sqrt() > HINT_FLOOR * per_mm
}

/// Whether a guide and an arc about a base only touch: they cross at next to no angle, or miss each other by no more than such
/// curves do.
fn touches(met: &Result<Pair, DrawError>) -> bool {
    match met {
        Ok(pair) => pair.crossing < TOUCHES,
        Err(DrawError::CannotAssemble { why, .. }) => {
            let (_, radius) = why.first;
            let reaches = match why.second.1 {
                Some(second) => [radius + second, (radius - second).abs()],
                None => [radius, radius],
            };
            reaches.iter().any(|reach| (why.distance - reach).abs() <= TOUCHES * TOUCHES * radius)
        }
        Err(_) => false,
    }
}

impl Draughtsman<'_> {
    /// Whether where two lines meet is not told: they only touch, or may do so for what the places leave open behind them.
    pub(super) fn is_unclear<E>(&mut self, met: &Result<Pair, E>) -> bool {
        let Ok(pair) = met else { return true };
        if pair.tangent || pair.crossing < TOUCHES {
            return true;
        }
        self.board.tape().aside(true);
        let at = self.board.take(*pair, Side::First);
        self.board.tape().aside(false);
        !self.is_told(at)
    }

    /// Whether a guide and an arc about a base only touch, or may do so for what the places leave open behind them.
    fn may_touch(&mut self, met: &Result<Pair, DrawError>, track: Track, circle: Circle) -> bool {
        if touches(met) {
            return true;
        }
        if met.is_ok() {
            return self.is_unclear(met);
        }
        self.board.tape().aside(true);
        let radius = circle.radius;
        let (reaches, away, marks) = match track {
            Track::Straight(line) => {
                let [_, across] = self.board.square_off(line, circle.centre);
                ([radius.value(); 2], across.value().abs(), vec![across.mark(), radius.mark()])
            }
            Track::Arc(arc) => {
                let apart = self.board.distance(circle.centre, arc.centre);
                let [r, s] = [radius.value(), arc.radius.value()];
                let marks = vec![apart.mark(), radius.mark(), arc.radius.mark()];
                ([r + s, (r - s).abs()], apart.value(), marks)
            }
        };
        self.board.tape().aside(false);
        let miss = reaches.iter().fold(f64::INFINITY, |least, reach| least.min((away - reach).abs()));
        miss <= self.left_open(&marks)
    }

    /// Finds the places of one group. Where something was missing that is the reason, whatever else went wrong.
    pub(super) fn position_of(&mut self, step: &GroupStep, group: &Group) -> Result<(), DrawError> {
        let drawn = self.draw_group(step, group);
        self.nothing_missing()?;
        drawn
    }

    fn draw_group(&mut self, step: &GroupStep, group: &Group) -> Result<(), DrawError> {
        match group.kind {
            GroupKind::Driver { base, input } => self.driver(step, group.links[0], base, input)?,
            GroupKind::Rrr { links, bases, pin } => self.rrr(step, links, bases, pin)?,
            GroupKind::Rrp { rod, base, pin, slide, rider } => {
                self.rrp(step, (rod, base), pin, (slide, rider))?;
            }
            GroupKind::Rpr { lever, base, pin, slide, rod } => {
                self.rpr(step, lever, base, pin, slide)?;
                self.ride_along(step, slide, rod, pin);
            }
            GroupKind::Prp { pin, slides, riders } => self.prp(step, pin, slides, riders)?,
            GroupKind::Rpp { link, point, lever, base, ride, slot } => {
                self.rpp(step, (link, point), (lever, base), (ride, slot))?;
            }
            GroupKind::Yoke { link, ride, pin, slot } => self.yoke(step, link, ride, pin, slot)?,
            GroupKind::DrivenSlide { slide, input } => self.driven_slide(step, slide, input),
            GroupKind::Wheel { wheel, centre, roll } => self.wheel(step, wheel, centre, roll)?,
            GroupKind::Planet { arm, base, wheel, centre, rolls } => {
                self.planet(step, (arm, base), (wheel, centre), rolls)?;
            }
            GroupKind::DrivenBar { .. } => self.driven_bar(step, group.kind)?,
            GroupKind::Driven { pin, holds, riders } => self.driven_pin(step, pin, holds, riders)?,
            GroupKind::Rack { link, roll, .. } => self.rack(step, link, roll)?,
            GroupKind::DrivenWheel { wheel, centre, roll, input, .. } => {
                self.driven_wheel(step, (wheel, centre), roll, input)?;
            }
            GroupKind::DrivenRack { link, wheel, centre, roll, input } => {
                self.driven_rack(step, (link, input), (wheel, centre), roll)?;
            }
            GroupKind::Rolling { rod, base, wheel, centre, roll } => {
                self.rolling(step, (rod, base), wheel, centre, roll)?;
            }
            GroupKind::RidingCentre { link, ride, wheel, centre, roll } => {
                self.riding_centre(step, (link, ride), (wheel, centre), roll)?;
            }
            GroupKind::HeldCentre { centre, holds } => self.held_centre(centre, holds)?,
            GroupKind::PinnedRack { link, base, wheel, centre, roll } => {
                self.pinned_rack(step, (link, base), (wheel, centre), roll)?;
            }
            GroupKind::Higher { trial } => self.position_by_trial(step, trial)?,
            GroupKind::Other => {
                return Err(DrawError::NoConstruction { links: group.links.clone() });
            }
        }
        // A block on an arc turns with the radius, and carries what points it has along.
        let mut blocks: Vec<LinkId> = step.points.iter().map(|(link, _)| *link).collect();
        blocks.dedup();
        for block in blocks {
            if self.mechanism.arc_of_block(block).is_some() && self.pose_of(block).is_some() {
                self.transfer_by_pose(step, block);
            }
        }
        Ok(())
    }

    /// Where the skeleton's own frame begins: the first fixed point, else the first placed one.
    pub(super) fn origin_of_space(&self) -> [Given; 2] {
        origin_of_space(self.mechanism)
    }

    /// Pricks world coordinates onto the skeleton.
    pub(super) fn prick_world(&mut self, world: [Given; 2]) -> Point {
        let origin = self.origin_of_space();
        let scale = self.length_scale();
        let coordinate = |d: &mut Self, axis: usize| {
            let (at, from) = (d.board.amount(world[axis]), d.board.amount(origin[axis]));
            let away = d.board.difference(at, from);
            d.board.to_paper(away, scale)
        };
        if world == origin {
            return self.board.origin();
        }
        let x = coordinate(self, 0);
        let y = coordinate(self, 1);
        self.board.prick(x, y)
    }

    /// Where a fixed or placed point stands. While a group is tried that is not placed as a whole, a place in it is
    /// a hint like any other.
    pub(super) fn given_place(&mut self, point: PointId) -> Option<Point> {
        if self.tried.points.contains(&point) { None } else { self.world_place(point) }
    }

    /// Whether a point's place is given, or was found from given places before the groups are drawn.
    pub(super) fn is_given(&self, point: PointId) -> bool {
        self.mechanism.is_given(point) || self.pricked[point.0].is_some()
    }

    /// The given place of a fixed or placed point, pricked once.
    pub(super) fn world_place(&mut self, point: PointId) -> Option<Point> {
        if self.pricked[point.0].is_none() {
            let world = self.mechanism.point(point).place.exact()?;
            self.pricked[point.0] = Some(self.prick_world(world));
        }
        self.pricked[point.0]
    }

    /// A rough place of a point, metres in the world: it chooses between assemblies.
    pub(super) fn hint_of(&self, point: PointId) -> Option<[f64; 2]> {
        let origin = self.origin_of_space().map(|g| g.value);
        let stands = || {
            let at = self.stated_hints[point.0].or(self.pricked[point.0])?.value();
            Some([0, 1].map(|k| origin[k] + at[k] * self.scales.length()))
        };
        self.mechanism.point(point).place.hint().or_else(stands)
    }

    /// That rough place as millimetres of the skeleton.
    pub(super) fn hint_on_paper(&self, point: PointId) -> Option<[f64; 2]> {
        let origin = self.origin_of_space().map(|g| g.value);
        let per_mm = self.scales.length();
        self.hint_of(point).map(|hint| [0, 1].map(|k| (hint[k] - origin[k]) / per_mm))
    }

    /// Notes the place of a point whose place is given; says whether it is.
    pub(super) fn prick_given(&mut self, point: PointId) -> bool {
        let Some(at) = self.given_place(point) else { return false };
        self.place(point, at);
        true
    }

    /// The place of a point that an earlier step found; what depends on one that none found is refused.
    pub(super) fn at(&mut self, point: PointId) -> Point {
        match self.places[point.0] {
            Some(at) => at,
            None => self.no_point(Missing::Place(point)),
        }
    }

    /// The angle of a driven link, where the input states it.
    pub(super) fn driven_angle(&mut self, input: Drive) -> Option<Angle> {
        match input {
            Drive::Input(input) => match self.mechanism.inputs[input] {
                Input::Angle { angle, .. } | Input::Speed { angle, .. } => {
                    angle.map(|angle| self.board.input_angle(input, angle))
                }
                Input::Slide { .. } => None,
            },
            Drive::Trial(driver) => self.tried_place(driver),
            Drive::With(_) => None,
        }
    }

    /// Where a trial driver is tried; none where it is placed.
    pub(super) fn tried_place(&self, driver: TrialDriver) -> Option<Angle> {
        self.tried_places.iter().find(|(of, _)| *of == driver).map(|&(_, place)| place)
    }

    /// A driven link: lay its points off along the given angle from its base.
    fn driver(
        &mut self,
        step: &GroupStep,
        link: LinkId,
        base: PointId,
        input: Drive,
    ) -> Result<(), DrawError> {
        if matches!(input, Drive::With(_)) && self.driver_by_rides(step, link, base) {
            return Ok(());
        }
        match self.driven_angle(input) {
            Some(angle) => {
                let along = self.board.protractor(angle);
                self.driver_along(step, link, base, along);
                Ok(())
            }
            None if matches!(self.mechanism.link(link).form, Form::Single) => {
                self.board.purpose("driven link");
                self.one_joint_link(link, base)?;
                self.transfer_by_pose(step, link);
                Ok(())
            }
            None => {
                self.driver_as_placed(step, link, base);
                Ok(())
            }
        }
    }

    /// A link about a pin that turns with others, where these lead its direction over from one that stands, and its own
    /// places do not tell it; says whether they do.
    fn driver_by_rides(&mut self, step: &GroupStep, link: LinkId, base: PointId) -> bool {
        let points = self.mechanism.link(link).points.clone();
        let given =
            points.into_iter().filter(|&p| p != base && self.is_given(p) && !self.tried.points.contains(&p));
        if self.stands_in_world(link) || given.count() > 0 {
            return false;
        }
        let Some((own_along, along)) = self.direction_by_rides(link, None, DEEPEST) else { return false };
        self.board.purpose("driven link");
        let (own_anchor, anchor) = (self.own(link, base), self.at(base));
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        self.transfer_by_pose(step, link);
        true
    }

    /// A driven link that stands by two of its points, which are placed.
    pub(super) fn driver_as_placed(&mut self, step: &GroupStep, link: LinkId, base: PointId) {
        let points = self.mechanism.link(link).points.clone();
        let mut placed = Vec::new();
        for &point in &points {
            if self.places[point.0].is_some() || self.prick_given(point) {
                placed.push(point);
            }
        }
        let &[first, second, ..] = self.mechanism.link(link).joints() else {
            self.miss_of(Missing::Joint(link));
            return;
        };
        if [first, second].iter().all(|p| placed.contains(p)) {
            let (a, b) = (self.at(first), self.at(second));
            let reason = self.reason(&[link]);
            let (along, _) = self.board.toward(a, b, reason);
            self.driver_along(step, link, base, along);
            return;
        }
        let Some(&far) = placed.iter().find(|&&p| p != base) else {
            self.miss_of(Missing::Pose(link));
            return;
        };
        self.pose_by_points(link, base, far);
        self.act(Act::MarkPlaces);
        self.transfer_by_pose(step, link);
    }

    /// How a link of one joint stands, which no input angle tells: where it rides as a link its x-axis follows that
    /// guide; where it carries a guide through its own joint it is turned until that meets its rider; otherwise its
    /// x-axis is the world's.
    pub(super) fn one_joint_link(&mut self, link: LinkId, base: PointId) -> Result<(), DrawError> {
        let (own_anchor, anchor) = (self.own(link, base), self.at(base));
        let ride =
            self.mechanism.slides.iter().position(
                |s| matches!(s.rider, Rider::Link { link: rider, turned: Some(_) } if rider == link),
            );
        if let Some(slide) = ride {
            let (own_along, along) = self.ride_directions(slide, link);
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
            return Ok(());
        }
        let Some(slide) = self.swivels_by(link) else {
            let x = self.board.rightward();
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along: x, along: x });
            return Ok(());
        };
        let at_rider =
            self.joint_of_rider(slide).and_then(|rider| Some((rider, self.place_by_places(rider)?)));
        let Some((rider, at_rider)) = at_rider else {
            self.miss_of(Missing::Pose(link));
            return Ok(());
        };
        let own_line = self.own_track(slide, Some(rider));
        self.swivel(link, (base, own_line), (slide, rider), at_rider)
    }

    /// The pair by whose guide a link of one joint swivels: of those that lead through that joint the first whose rider
    /// stands, whatever their order in the scene.
    pub(super) fn swivels_by(&mut self, link: LinkId) -> Option<usize> {
        let pairs: Vec<usize> =
            (0..self.mechanism.slides.len()).filter(|&slide| self.swivels_on(link, slide)).collect();
        let stands = |d: &mut Self, slide: usize| {
            let rider = d.joint_of_rider(slide);
            rider.is_some_and(|rider| d.places[rider.0].is_some() || d.given_place(rider).is_some())
        };
        pairs.iter().copied().find(|&slide| stands(self, slide)).or(pairs.first().copied())
    }

    /// Whether a link of one joint may swivel by this pair: its guide leads through that joint.
    pub(super) fn swivels_on(&self, link: LinkId, slide: usize) -> bool {
        let guide = self.mechanism.slides[slide].guide;
        let Path::Straight { through, .. } = guide.path else { return false };
        let own = match through {
            GuidePoint::Point(p) => self.mechanism.link(link).points.first() == Some(&p),
            GuidePoint::Own(at) => at.iter().all(|c| *c == Given::exact(0.0)),
        };
        matches!(self.mechanism.link(link).form, Form::Single) && own && guide.link == link
    }

    /// Whether a link of one joint points towards the rider of its guide, where nothing but that says how it stands: a link
    /// that turns with its rider has the angle of either end of its guide.
    pub(super) fn faces_rider(&mut self, link: LinkId) -> bool {
        let told = self.mechanism.inputs.iter().any(|input| {
            matches!(*input, Input::Angle { link: driven, angle: Some(_), .. }
                | Input::Speed { link: driven, angle: Some(_), .. } if driven == link)
        });
        let rides = self
            .mechanism
            .slides
            .iter()
            .any(|s| matches!(s.rider, Rider::Link { link: rider, .. } if rider == link));
        let Some(slide) = self.swivels_by(link).filter(|_| !told && !rides) else { return true };
        let base = self.mechanism.link(link).points.first().and_then(|p| self.places[p.0]);
        let rider = self.joint_of_rider(slide).and_then(|rider| self.places[rider.0]);
        let (Some(base), Some(rider)) = (base, rider) else { return true };
        let [own, guide] = [self.own_track(slide, None), self.track(slide, None)];
        let (Track::Straight(own), Track::Straight(guide)) = (own, guide) else { return true };
        let ([x, y], [from_x, from_y]) = (rider.value(), base.value());
        let [cos, sin] = guide.along.value();
        let forward = (x - from_x) * cos + (y - from_y) * sin;
        let onward = if own.along.value()[0] < -SQUARE { -1.0 } else { 1.0 };
        forward * onward > -SQUARE * libm::hypot(x - from_x, y - from_y)
    }

    /// The pin that rides in a sliding pair, or the first joint of the link that does.
    pub(super) fn joint_of_rider(&self, slide: usize) -> Option<PointId> {
        match self.mechanism.slides[slide].rider {
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied(),
        }
    }

    /// Whether a link of one joint has the world's axes at this instant.
    pub(super) fn has_axes_of_world(&self, link: LinkId) -> bool {
        let rides = self
            .mechanism
            .slides
            .iter()
            .any(|s| matches!(s.rider, Rider::Link { link: rider, turned: Some(_) } if rider == link));
        matches!(self.mechanism.link(link).form, Form::Single)
            && !rides
            && !(0..self.mechanism.slides.len()).any(|slide| self.swivels_on(link, slide))
    }

    /// Turns a link of one joint until its guide meets its rider, at the end of its line that lies further along the
    /// link's x-axis; where the guide is square to that, forward on the guide. Of a link that rides its first joint
    /// counts, wherever the pin is by which it is found.
    fn swivel(
        &mut self,
        link: LinkId,
        (base, own_track): (PointId, Track),
        (slide, rider): (usize, PointId),
        at_rider: Point,
    ) -> Result<(), DrawError> {
        let (own_anchor, anchor) = (self.own(link, base), self.at(base));
        let reason = self.reason(&[link]);
        let (along, distance) = self.board.toward(anchor, at_rider, reason);
        let circle = Circle { centre: own_anchor, radius: distance };
        let pair = self.meet_track(own_track, circle, (link, base), (slide, rider))?;
        let (Track::Straight(guide), Track::Straight(own_line)) = (self.own_track(slide, None), own_track)
        else {
            return Err(DrawError::Missing(Missing::StraightGuide(link)));
        };
        let [foot, _] = self.board.square_off(guide, own_anchor).map(|mm| mm.value());
        let ([cos, sin], start) = (guide.along.value(), own_line.through.value());
        let onward = if cos < -SQUARE { -1.0 } else { 1.0 };
        let faces = |side: Side| {
            let at = self.board.look(&pair, side);
            let forward = (at[0] - start[0]) * cos + (at[1] - start[1]) * sin;
            (forward - foot) * onward > -SQUARE * distance.value()
        };
        let side = match [Side::First, Side::Second].map(faces) {
            _ if pair.tangent => Side::First,
            [true, false] => Side::First,
            [false, true] => Side::Second,
            [false, false] => return Err(DrawError::NoClosure { pin: rider, least: f64::INFINITY }),
            [true, true] => self.swivel_by_hints(link, (own_anchor, anchor), along, (slide, rider), pair)?,
        };
        let own_rider = self.board.take(pair, side);
        let (own_along, _) = self.board.toward(own_anchor, own_rider, reason);
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        Ok(())
    }

    /// Of two ways in which a swivelling guide meets the link that rides on it, the one that the hints for that
    /// link's points choose.
    fn swivel_by_hints(
        &mut self,
        link: LinkId,
        (own_anchor, anchor): (Point, Point),
        along: Direction,
        (slide, pin): (usize, PointId),
        pair: Pair,
    ) -> Result<Side, DrawError> {
        let Rider::Link { link: rod, .. } = self.mechanism.slides[slide].rider else {
            // Both ends of a guide on which a pin rides, in one place.
            return Ok(Side::First);
        };
        let reason = self.reason(&[link]);
        let at_pin = self.at(pin);
        let own_pin = self.own(rod, pin);
        let poses = [Side::First, Side::Second].map(|side| {
            let own_rider = self.board.take(pair, side);
            let (own_along, _) = self.board.toward(own_anchor, own_rider, reason);
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
            let (own_along, along) = self.ride_directions(slide, rod);
            Pose { own_anchor: own_pin, anchor: at_pin, own_along, along }
        });
        self.poses[link.0] = None;
        self.choose_pose(rod, poses, pin)
    }

    /// A driven link whose first-to-second line points `along`.
    pub(super) fn driver_along(&mut self, step: &GroupStep, link: LinkId, base: PointId, along: Direction) {
        self.board.purpose("driven link");
        let from = self.at(base);
        let own_anchor = self.own(link, base);
        let &[first, second, ..] = self.mechanism.link(link).joints() else {
            // A swivelling guide of one joint: the angle is that of its own x-axis.
            let own_along = self.board.rightward();
            self.poses[link.0] = Some(Pose { own_anchor, anchor: from, own_along, along });
            self.transfer_by_pose(step, link);
            return;
        };
        let (a, b) = (self.own(link, first), self.own(link, second));
        let reason = self.reason(&[link]);
        let (own_along, _) = self.board.toward(a, b, reason);
        self.poses[link.0] = Some(Pose { own_anchor, anchor: from, own_along, along });
        for &(_, point) in &step.points {
            if self.prick_given(point) {
                self.act(Act::MarkPlaces);
                continue;
            }
            let at = self.lay_off_driven(link, (first, second), base, point, (from, along));
            self.place(point, at);
            let length = self.length(link, base, point).value();
            let to = at.value();
            let from = from.value();
            let angle = libm::atan2(to[1] - from[1], to[0] - from[0]);
            self.act(Act::LayOffLink { link, from: base, to: point, angle, length });
        }
    }

    /// A slide whose place along its guide is given.
    fn driven_slide(&mut self, step: &GroupStep, slide: usize, input: Drive) {
        self.board.purpose("driven slide");
        let rider = self.mechanism.slides[slide].rider;
        let first = match rider {
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => self.mechanism.link(link).points.first().copied(),
        };
        let Some(first) = first else {
            if let Rider::Link { link, .. } = rider {
                self.miss_of(Missing::Joint(link));
            }
            return;
        };
        self.act(Act::DrawGuide { slide });
        match input {
            Drive::Input(_) if self.prick_given(first) => {}
            Drive::Input(input) => {
                let Input::Slide { at: Some(at), .. } = self.mechanism.inputs[input] else {
                    self.miss_of(Missing::Input(input));
                    return;
                };
                let line = self.straight_track(slide, None);
                let at = self.board.input_amount(input, at);
                let scale = self.length_scale();
                let mm = self.board.to_paper(at, scale);
                let place = self.board.lay_off(line.through, line.along, mm);
                self.place(first, place);
                let length = at.value();
                self.act(Act::LayOffAlong { slide, point: first, length });
            }
            Drive::With(link) => {
                self.miss_of(Missing::Pose(link));
            }
            Drive::Trial(driver) => match (self.tried_place(driver), self.track(slide, None)) {
                (Some(at), Track::Straight(line)) => {
                    let mm = self.board.arc_length(at);
                    let place = self.board.lay_off(line.through, line.along, mm);
                    self.place(first, place);
                }
                (Some(at), Track::Arc(arc)) => {
                    let along = self.board.protractor(at);
                    let place = self.board.lay_off(arc.centre, along, arc.radius);
                    self.place(first, place);
                }
                (None, _) => {
                    if !self.prick_given(first) {
                        self.miss_of(Missing::Place(first));
                    }
                }
            },
        }
        self.act(Act::MarkPlaces);
        if let Rider::Link { link, .. } = rider {
            let own_anchor = self.own(link, first);
            let anchor = self.at(first);
            let (own_along, along) = self.ride_directions(slide, link);
            self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
            self.transfer_by_pose(step, link);
        }
    }

    /// A wheel's centre at the end of a rod: it runs on the parallel to the line, or the circle, on which it
    /// rolls.
    fn rolling(
        &mut self,
        step: &GroupStep,
        (rod, base): (LinkId, PointId),
        wheel: LinkId,
        centre: PointId,
        roll: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("centre of a rolling wheel");
        let main = [(rod, base)];
        if self.prick_given(centre) {
            self.act(Act::MarkPlaces);
        } else {
            let circle = self.circle(main[0], centre);
            self.meet_centre((rod, base), circle, &main, (centre, roll, wheel))?;
        }
        self.transfer_points(step, &main, centre);
        self.contact(wheel, roll);
        Ok(())
    }

    /// A riding link whose centre is held against a body: the parallel to the guide on which that centre rides meets
    /// the track on which the contact holds it.
    fn riding_centre(
        &mut self,
        step: &GroupStep,
        (link, ride): (LinkId, usize),
        (wheel, centre): (LinkId, PointId),
        roll: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("riding link on a rolling contact");
        self.act(Act::DrawGuide { slide: ride });
        if self.prick_given(centre) {
            self.act(Act::MarkPlaces);
        } else {
            let Track::Straight(line) = self.riding_track(ride, Some(link), centre) else {
                return Err(DrawError::NoConstruction { links: vec![link] });
            };
            let reason = self.reason(&[link, wheel]);
            let mut places: Vec<(Point, f64)> = Vec::new();
            for track in self.centre_tracks(roll, wheel) {
                match track {
                    Track::Straight(other) => {
                        let meet = self.board.meet_lines(line, other, reason);
                        places.push((meet.at, meet.crossing));
                    }
                    Track::Arc(arc) => {
                        let Ok(pair) = self.board.meet_line_circle(line, arc, reason) else { continue };
                        let sides =
                            if pair.tangent { &[Side::First][..] } else { &[Side::First, Side::Second] };
                        places.extend(sides.iter().map(|&side| (self.board.take(pair, side), pair.crossing)));
                    }
                }
            }
            let (own_along, along) = self.ride_directions(ride, link);
            let own_anchor = self.own(link, centre);
            let pose = |anchor| Pose { own_anchor, anchor, own_along, along };
            let tried: Vec<_> = places.iter().map(|&(at, _)| self.hints_of_pose(link, pose(at))).collect();
            let misses: Vec<Option<f64>> = tried.iter().map(|(miss, ..)| *miss).collect();
            let best = self.nearest_to_hints(centre, &places, &misses)?;
            self.chosen(best);
            let (at, crossing) = places[best];
            self.place(centre, at);
            self.act(Act::MarkIntersection { point: centre, crossing });
        }
        self.ride_along(step, ride, Some(link), centre);
        self.contact(wheel, roll);
        Ok(())
    }

    /// Which of some places of a wheel's centre its rough places choose, by how far each misses them, in squares.
    fn nearest_to_hints(
        &self,
        centre: PointId,
        places: &[(Point, f64)],
        misses: &[Option<f64>],
    ) -> Result<usize, DrawError> {
        let least = |index: usize| misses[index].unwrap_or(f64::INFINITY);
        let Some(best) = (0..places.len()).min_by(|&a, &b| least(a).total_cmp(&least(b))) else {
            return Err(DrawError::NoClosure { pin: centre, least: f64::INFINITY });
        };
        let per_mm = self.scales.length();
        let rival = (0..places.len()).find(|&other| {
            other != best && !(misses[best].is_some() && chooses(least(best), least(other), per_mm))
        });
        let Some(rival) = rival else { return Ok(best) };
        let origin = self.origin_of_space().map(|g| g.value);
        let world = |at: [f64; 2]| [0, 1].map(|k| origin[k] + at[k] * per_mm);
        let [first, second] = [best, rival].map(|index| world(places[index].0.value()));
        Err(DrawError::Ambiguous { pin: centre, first, second })
    }

    /// A rolling wheel's centre on the arc of a link about its base; the hints beside it are those of these rods.
    fn meet_centre(
        &mut self,
        (link, base): (LinkId, PointId),
        circle: Circle,
        rods: &[(LinkId, PointId)],
        (centre, roll, wheel): (PointId, usize, LinkId),
    ) -> Result<(), DrawError> {
        let reason = self.reason(&[link, wheel]);
        let mut met = Vec::new();
        let tracks = self.centre_tracks(roll, wheel);
        for track in &tracks {
            met.push(match *track {
                Track::Straight(line) => self.board.meet_line_circle(line, circle, reason),
                Track::Arc(arc) => self.board.meet_circles(circle, arc, reason),
            });
        }
        // The hint also chooses the side of the line on which the wheel rolls.
        let mut nearest: Option<(usize, Pair, f64)> = None;
        for (track, met) in met.into_iter().enumerate() {
            let Ok(pair) = met else { continue };
            let misses = if self.hint_of(centre).is_some() {
                [Side::First, Side::Second]
                    .map(|side| self.miss_of_hint(centre, self.board.look(&pair, side)))
            } else {
                self.hints_beside(rods, None, centre, pair)
            };
            let miss = misses.into_iter().flatten().fold(f64::INFINITY, f64::min);
            if nearest.is_none_or(|(.., least)| miss < least) {
                nearest = Some((track, pair, miss));
            }
        }
        let Some((track, pair, _)) = nearest else {
            return Err(DrawError::NoClosure { pin: centre, least: f64::INFINITY });
        };
        self.chosen(track);
        let radius = circle.radius.value() * self.scales.length();
        self.act(Act::DrawCentrePath { centre, roll });
        self.act(Act::StrikeArc { centre: base, to: centre, radius });
        self.take_hinted(rods, None, centre, pair)?;
        /// Of the radius of the arc.
        const PIECE: f64 = 0.3;
        let at = self.at(centre).value();
        let step = self.step_index();
        let path = match tracks.get(track) {
            Some(Track::Straight(line)) => {
                // A piece of it: it is drawn where the arc meets it.
                let through = line.through.value();
                let far = libm::hypot(through[0] - at[0], through[1] - at[1]);
                let part = (PIECE * circle.radius.value() / far.max(f64::MIN_POSITIVE)).min(1.0);
                let from = [0, 1].map(|k| at[k] + part * (through[k] - at[k]));
                Some(ConstructionLine::Ray { from, to: at, claim: None, step })
            }
            Some(Track::Arc(arc)) => {
                let (centre, radius) = (arc.centre.value(), arc.radius.value());
                Some(ConstructionLine::Arc { centre, radius, at, step })
            }
            None => None,
        };
        path.into_iter().for_each(|path| self.space_line(path));
        let (centre, radius) = (circle.centre.value(), circle.radius.value());
        self.space_line(ConstructionLine::Arc { centre, radius, at, step });
        Ok(())
    }

    /// A wheel's centre where two tracks of it meet: those on which contacts hold it, or a guide.
    fn held_centre(&mut self, centre: PointId, holds: [Hold; 2]) -> Result<(), DrawError> {
        self.board.purpose("centre held by contacts");
        if self.prick_given(centre) {
            self.act(Act::MarkPlaces);
        } else {
            let [first, second] = holds.map(|hold| match hold {
                Hold::Slide(slide) => {
                    self.act(Act::DrawGuide { slide });
                    vec![self.track(slide, Some(centre))]
                }
                Hold::Contact { roll, wheel } => {
                    self.act(Act::DrawCentrePath { centre, roll });
                    self.centre_tracks(roll, wheel)
                }
                Hold::Rod { .. } | Hold::Ram(_) => Vec::new(),
            });
            let links = self.mechanism.point(centre).links.clone();
            let reason = self.reason(&links);
            let mut places: Vec<(Point, f64)> = Vec::new();
            for (one, other) in first.iter().flat_map(|&one| second.iter().map(move |&other| (one, other))) {
                let met = match (one, other) {
                    (Track::Straight(one), Track::Straight(other)) => {
                        let meet = self.board.meet_lines(one, other, reason);
                        places.push((meet.at, meet.crossing));
                        continue;
                    }
                    (Track::Straight(line), Track::Arc(arc)) | (Track::Arc(arc), Track::Straight(line)) => {
                        self.board.meet_line_circle(line, arc, reason)
                    }
                    (Track::Arc(one), Track::Arc(other)) => self.board.meet_circles(one, other, reason),
                };
                let Ok(pair) = met else { continue };
                let sides = if pair.tangent { &[Side::First][..] } else { &[Side::First, Side::Second] };
                places.extend(sides.iter().map(|&side| (self.board.take(pair, side), pair.crossing)));
            }
            let misses: Vec<Option<f64>> =
                places.iter().map(|(at, _)| self.miss_of_hint(centre, at.value())).collect();
            let best = self.nearest_to_hints(centre, &places, &misses)?;
            self.chosen(best);
            let (at, crossing) = places[best];
            self.place(centre, at);
            self.act(Act::MarkIntersection { point: centre, crossing });
        }
        for hold in holds {
            if let Hold::Contact { roll, wheel } = hold {
                self.contact(wheel, roll);
            }
        }
        Ok(())
    }

    /// The tracks of a rolling wheel's centre: beside the line on either side, or about the other centre.
    pub(super) fn centre_tracks(&mut self, roll: usize, wheel: LinkId) -> Vec<Track> {
        let scale = self.length_scale();
        match self.mechanism.rolls[roll] {
            Roll::Circles { links, centres, radii, internal } => {
                let other = usize::from(links[0] == wheel);
                let [a, b] = radii.map(|r| self.board.amount(r));
                let radius = if internal {
                    let difference = self.board.difference(a, b);
                    self.board.magnitude(difference)
                } else {
                    self.board.sum(a, b)
                };
                let radius = self.board.to_paper(radius, scale);
                vec![Track::Arc(Circle { centre: self.at(centres[other]), radius })]
            }
            Roll::Line { guide, radius, .. } => {
                let line = self.line_of(&guide);
                let radius = self.board.amount(radius);
                let mm = self.board.to_paper(radius, scale);
                let left = self.board.quarter_turn(line.along);
                let right = self.board.reverse(left);
                let beside = |d: &mut Self, way: Direction| {
                    let through = d.board.lay_off(line.through, way, mm);
                    Track::Straight(Line { through, along: line.along })
                };
                vec![beside(self, left), beside(self, right)]
            }
        }
    }

    /// Square of the distance of a place on paper from a point's hint, in metres.
    pub(super) fn miss_of_hint(&self, point: PointId, at: [f64; 2]) -> Option<f64> {
        let origin = self.origin_of_space().map(|g| g.value);
        self.hint_of(point).map(|hint| {
            let [dx, dy] = [0, 1].map(|k| origin[k] + at[k] * self.scales.length() - hint[k]);
            dx * dx + dy * dy
        })
    }

    /// A driven link that two pairs hold: each of them is a track of one of its points, by the link's own lengths and its
    /// direction.
    fn driven_bar(&mut self, step: &GroupStep, kind: GroupKind) -> Result<(), DrawError> {
        let GroupKind::DrivenBar { link, point, pins, holds, riders, under, input } = kind else {
            return Ok(());
        };
        self.board.purpose("driven link on two guides");
        let rods: Vec<(LinkId, PointId, PointId)> =
            (0..2).filter_map(|i| holds[i].rod().map(|(rod, base)| (rod, base, pins[i]))).collect();
        if !rods.is_empty() && self.bar_by_places(step, (link, &rods), riders) {
            return Ok(());
        }
        for slide in holds.into_iter().filter_map(Hold::slide) {
            self.act(Act::DrawGuide { slide });
        }
        let own_point = self.own(link, point);
        let (own_along, along) = self.bar_direction(link, input)?;
        let pose = |own_anchor, anchor| Some(Pose { own_anchor, anchor, own_along, along });
        if self.prick_given(point) {
            self.act(Act::MarkPlaces);
        } else {
            let mut tracks = Vec::new();
            for i in 0..2 {
                // The track of what the pair holds, and where that lies in the link's own figure.
                let (held, track) = match holds[i] {
                    // Where rolling holds it, its place is given.
                    Hold::Contact { .. } | Hold::Ram(_) => return Err(DrawError::NotPlaced { point }),
                    Hold::Slide(slide) if under[i] => {
                        let at = self.at(pins[i]);
                        match self.own_track(slide, Some(pins[i])) {
                            Track::Straight(line) => {
                                let along = self.turned_with(line.along, own_along, along);
                                (line.through, Track::Straight(Line { through: at, along }))
                            }
                            Track::Arc(arc) => {
                                (arc.centre, Track::Arc(Circle { centre: at, radius: arc.radius }))
                            }
                        }
                    }
                    Hold::Slide(slide) => {
                        let track = self.riding_track(slide, riders[i], pins[i]);
                        (self.own(link, pins[i]), track)
                    }
                    Hold::Rod { rod, base } => {
                        let circle = self.circle((rod, base), pins[i]);
                        (self.own(link, pins[i]), Track::Arc(circle))
                    }
                };
                if pins[i] == point && !under[i] {
                    if let (Track::Arc(circle), Some((_, base))) = (track, holds[i].rod()) {
                        let radius = circle.radius.value() * self.scales.length();
                        self.act(Act::StrikeArc { centre: base, to: point, radius });
                    }
                    tracks.push(track);
                    continue;
                }
                let from = match track {
                    Track::Straight(line) => line.through,
                    Track::Arc(arc) => arc.centre,
                };
                self.poses[link.0] = pose(held, from);
                let through = self.carried_point(link, own_point);
                if let (Track::Arc(circle), Some((_, base))) = (track, holds[i].rod()) {
                    self.strike_shifted(base, [pins[i], point], circle, through);
                }
                tracks.push(match track {
                    Track::Straight(line) => Track::Straight(Line { through, along: line.along }),
                    Track::Arc(arc) => Track::Arc(Circle { centre: through, radius: arc.radius }),
                });
            }
            match (&tracks[..], holds.map(Hold::slide)) {
                (&[first, second], [Some(one), Some(other)]) => {
                    self.meet_tracks([first, second], point, [one, other])?;
                }
                (&[first, second], _) => {
                    let pose = |anchor| Pose { own_anchor: own_point, anchor, own_along, along };
                    self.meet_rods([first, second], (link, point), &rods, pose)?;
                }
                _ => {}
            }
        }
        self.poses[link.0] = pose(own_point, self.at(point));
        for i in 0..2 {
            if under[i] || pins[i] == point || self.prick_given(pins[i]) {
                continue;
            }
            let own = self.own(link, pins[i]);
            let at = self.carried_point(link, own);
            self.place(pins[i], at);
            self.act(Act::TransferPoint { link, point: pins[i] });
        }
        self.transfer_by_pose(step, link);
        for ((hold, rider), pin) in holds.into_iter().zip(riders).zip(pins) {
            match hold {
                Hold::Slide(slide) => self.ride_along(step, slide, rider, pin),
                Hold::Contact { roll, wheel } => self.contact(wheel, roll),
                Hold::Rod { rod, base } => self.transfer_points(step, &[(rod, base)], pin),
                Hold::Ram(ram) => self.lay_on_ram(step, ram, rider, pin)?,
            }
        }
        Ok(())
    }

    /// A pin at the distance to which it is driven along a lever: the arc about the lever's base meets that of a rod, or a
    /// guide. Then the lever is laid on.
    fn driven_pin(
        &mut self,
        step: &GroupStep,
        pin: PointId,
        holds: [Hold; 2],
        riders: [Option<LinkId>; 2],
    ) -> Result<(), DrawError> {
        self.board.purpose("pin at a driven distance");
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
        } else {
            self.meet_driven(pin, holds, riders)?;
        }
        for (hold, rider) in holds.into_iter().zip(riders) {
            match hold {
                Hold::Rod { rod, base } => self.transfer_points(step, &[(rod, base)], pin),
                Hold::Slide(slide) => self.ride_along(step, slide, rider, pin),
                Hold::Contact { roll, wheel } => self.contact(wheel, roll),
                Hold::Ram(ram) => self.lay_on_ram(step, ram, rider, pin)?,
            }
        }
        Ok(())
    }

    /// Where the tracks of a driven pin meet.
    fn meet_driven(
        &mut self,
        pin: PointId,
        holds: [Hold; 2],
        riders: [Option<LinkId>; 2],
    ) -> Result<(), DrawError> {
        let mut arcs: Vec<((LinkId, PointId), Circle)> = Vec::new();
        let mut guides = Vec::new();
        let mut touching = None;
        for (hold, rider) in holds.into_iter().zip(riders) {
            match hold {
                Hold::Rod { rod, base } => arcs.push(((rod, base), self.circle((rod, base), pin))),
                Hold::Ram(ram) => {
                    let Some([from, to]) = self.own_reach(ram, rider, pin) else {
                        return Err(DrawError::NotPlaced { point: pin });
                    };
                    let circle = Circle { centre: self.at(ram.base), radius: self.board.distance(from, to) };
                    arcs.push(((ram.lever, ram.base), circle));
                }
                Hold::Slide(slide) => guides.push((slide, self.riding_track(slide, rider, pin))),
                Hold::Contact { roll, wheel } => touching = Some((pin, roll, wheel)),
            }
        }
        if let (&[(main, circle)], Some(touching)) = (arcs.as_slice(), touching) {
            return self.meet_centre(main, circle, &[], touching);
        }
        let links: Vec<LinkId> = arcs.iter().map(|&((link, _), _)| link).collect();
        let (pair, beside) = match (arcs.as_slice(), guides.as_slice()) {
            (&[(main, circle)], &[(slide, track)]) => {
                self.act(Act::DrawGuide { slide });
                (self.meet_track(track, circle, main, (slide, pin))?, riders[1].map(|link| (slide, link)))
            }
            (&[(main, circle), ((_, base), other)], []) => {
                let reason = self.reason(&links);
                let per_mm = self.scales.length();
                let [dx, dy] = self.board.between(circle.centre, other.centre).map(|d| d.value());
                let name = |d: &Self, point: PointId| d.mechanism.point(point).name.clone();
                let met = self.board.meet_circles(circle, other, reason);
                let pair = met.map_err(|_| DrawError::CannotAssemble {
                    pin,
                    why: Box::new(Misfit {
                        first: (name(self, main.1), circle.radius.value() * per_mm),
                        second: (name(self, base), Some(other.radius.value() * per_mm)),
                        pin: name(self, pin),
                        distance: libm::hypot(dx, dy) * per_mm,
                    }),
                    range: None,
                })?;
                (pair, None)
            }
            _ => return Err(DrawError::NoConstruction { links }),
        };
        for &((_, base), circle) in &arcs {
            let radius = circle.radius.value() * self.scales.length();
            self.act(Act::StrikeArc { centre: base, to: pin, radius });
        }
        let rods: Vec<(LinkId, PointId)> = holds.into_iter().filter_map(Hold::rod).collect();
        self.take_hinted(&rods, beside, pin, pair)?;
        let (at, step) = (self.at(pin).value(), self.step_index());
        for (_, circle) in arcs {
            let (centre, radius) = (circle.centre.value(), circle.radius.value());
            self.space_line(ConstructionLine::Arc { centre, radius, at, step });
        }
        Ok(())
    }

    /// Of a driven lever and its partner the places of the base and of the driven pin in the figure of that which carries
    /// the guide; none where the input says no place along it.
    fn own_reach(&mut self, ram: Ram, partner: Option<LinkId>, pin: PointId) -> Option<[Point; 2]> {
        let Input::Slide { at: Some(at), .. } = self.mechanism.inputs[ram.input] else { return None };
        let (carrier, joint, rider) = match partner {
            Some(carrier) if ram.slides(self.mechanism) => (carrier, pin, ram.base),
            _ => (ram.lever, ram.base, pin),
        };
        // A rider of placed points is where these are.
        let as_placed = matches!(self.mechanism.slides[ram.slide].rider, Rider::Link { turned: None, .. });
        if as_placed && self.joint_of_rider(ram.slide) != Some(rider) {
            return None;
        }
        let Track::Straight(line) = self.own_track(ram.slide, Some(rider)) else { return None };
        let at = self.board.input_amount(ram.input, at);
        let scale = self.length_scale();
        let mm = self.board.to_paper(at, scale);
        let end = self.board.lay_off(line.through, line.along, mm);
        Some([self.own(carrier, joint), end])
    }

    /// Lays on a driven lever with what slides on it, when its base and the driven pin stand.
    fn lay_on_ram(
        &mut self,
        step: &GroupStep,
        ram: Ram,
        partner: Option<LinkId>,
        pin: PointId,
    ) -> Result<(), DrawError> {
        let (carrier, joint, rider) = match partner {
            Some(carrier) if ram.slides(self.mechanism) => (carrier, pin, ram.base),
            _ => (ram.lever, ram.base, pin),
        };
        match self.own_reach(ram, partner, pin) {
            Some([own_joint, own_rider]) if !self.stands_in_world(carrier) => {
                self.act(Act::DrawGuide { slide: ram.slide });
                let (anchor, at_rider) = (self.at(joint), self.at(rider));
                let reason = self.reason(&[ram.lever]);
                let (own_along, _) = self.board.toward(own_joint, own_rider, reason);
                let (along, _) = self.board.toward(anchor, at_rider, reason);
                self.poses[carrier.0] = Some(Pose { own_anchor: own_joint, anchor, own_along, along });
                self.transfer_by_pose(step, carrier);
            }
            _ => self.rpr(step, carrier, joint, rider, ram.slide)?,
        }
        let sliding = if carrier == ram.lever { partner } else { Some(ram.lever) };
        self.ride_along(step, ram.slide, sliding, rider);
        Ok(())
    }

    /// Lays on a driven link and its rods where given places tell how each of them stands; says whether they do.
    fn bar_by_places(
        &mut self,
        step: &GroupStep,
        (link, rods): (LinkId, &[(LinkId, PointId, PointId)]),
        riders: [Option<LinkId>; 2],
    ) -> bool {
        let arms = rods.iter().map(|&(rod, ..)| rod);
        let links: Vec<LinkId> = [link].into_iter().chain(arms).chain(riders.into_iter().flatten()).collect();
        let mut points: Vec<PointId> = Vec::new();
        for point in links.iter().flat_map(|&link| &self.mechanism.link(link).points) {
            if !self.mechanism.is_fixed(*point) && !points.contains(point) {
                points.push(*point);
            }
        }
        if !points.iter().any(|&p| self.is_given(p)) || !self.lay_on_by_places(links, &points, step) {
            return false;
        }
        self.act(Act::MarkPlaces);
        true
    }

    /// The arc on which one pin of a driven link lies, shifted by the link's own line to another pin: what holds the one
    /// holds the other there.
    fn strike_shifted(&mut self, base: PointId, [from, to]: [PointId; 2], circle: Circle, centre: Point) {
        let [x, y] = self.board.between(circle.centre, centre).map(|d| d.value());
        let per_mm = self.scales.length();
        let (angle, length) = (libm::atan2(y, x), libm::hypot(x, y) * per_mm);
        self.act(Act::LayOffShift { base, line: [from, to], angle, length });
        let radius = circle.radius.value() * per_mm;
        self.act(Act::StrikeArcThere { ends: [base, from], point: to, radius });
        let claim = Claim::Parallel(Reference::Points(from, to));
        let step = self.step_index();
        let (from, to) = (circle.centre.value(), centre.value());
        self.space_line(ConstructionLine::Ray { from, to, claim: Some(claim), step });
    }

    /// Where the tracks of a driven link's first pin meet, one of which at least is an arc. Hints for the joints choose;
    /// where they are silent, those for further points of the links.
    fn meet_rods(
        &mut self,
        tracks: [Track; 2],
        (link, point): (LinkId, PointId),
        rods: &[(LinkId, PointId, PointId)],
        pose: impl Fn(Point) -> Pose,
    ) -> Result<(), DrawError> {
        let links: Vec<LinkId> = [link].into_iter().chain(rods.iter().map(|&(rod, ..)| rod)).collect();
        let reason = self.reason(&links);
        let per_mm = self.scales.length();
        let ([Track::Arc(arc), other] | [other, Track::Arc(arc)]) = tracks else {
            return Err(DrawError::NoConstruction { links });
        };
        let name = |d: &Self, base: PointId| d.mechanism.point(base).name.clone();
        let first = match *rods {
            [(_, base, _), ..] => (name(self, base), arc.radius.value() * per_mm),
            [] => return Err(DrawError::NoConstruction { links }),
        };
        let (met, second, distance) = match other {
            Track::Straight(line) => {
                let [_, across] = self.board.square_off(line, arc.centre);
                let met = self.board.meet_line_circle(line, arc, reason);
                (met, (String::new(), None), across.value().abs())
            }
            Track::Arc(circle) => {
                let [dx, dy] = self.board.between(arc.centre, circle.centre).map(|d| d.value());
                let met = self.board.meet_circles(arc, circle, reason);
                let about = match *rods {
                    [_, (_, base, _), ..] => name(self, base),
                    _ => "centre of the guide-".to_owned(),
                };
                (met, (about, Some(circle.radius.value() * per_mm)), libm::hypot(dx, dy))
            }
        };
        let pair = met.map_err(|_| DrawError::CannotAssemble {
            pin: point,
            why: Box::new(Misfit { first, second, pin: name(self, point), distance: distance * per_mm }),
            range: None,
        })?;
        let mut side = if pair.tangent {
            Side::First
        } else {
            let poses = [Side::First, Side::Second].map(|side| pose(self.board.take(pair, side)));
            self.choose_bar(link, poses, point, rods)?
        };
        if self.takes_other_side(point) {
            side = side.other();
        }
        self.chosen(usize::from(side == Side::Second));
        let taken = self.board.take(pair, side);
        self.place(point, taken);
        self.act(Act::MarkIntersection { point, crossing: pair.crossing });
        let (at, step) = (taken.value(), self.step_index());
        for track in tracks {
            if let Track::Arc(circle) = track {
                let (centre, radius) = (circle.centre.value(), circle.radius.value());
                self.space_line(ConstructionLine::Arc { centre, radius, at, step });
            }
        }
        Ok(())
    }

    /// Which of two poses of a driven link the hints choose: those for the pins of its rods first.
    fn choose_bar(
        &mut self,
        link: LinkId,
        poses: [Pose; 2],
        point: PointId,
        rods: &[(LinkId, PointId, PointId)],
    ) -> Result<Side, DrawError> {
        if let Some(side) = self.prescribed_side() {
            return Ok(side);
        }
        let per_mm = self.scales.length();
        let chosen = |score: [f64; 2]| match score {
            [a, b] if chooses(a, b, per_mm) => Some(Side::First),
            [a, b] if chooses(b, a, per_mm) => Some(Side::Second),
            _ => None,
        };
        let before = self.poses[link.0];
        let mut joints = [0.0; 2];
        let mut beside = [0.0; 2];
        let mut shown = [[0.0; 2]; 2];
        for (i, pose) in poses.into_iter().enumerate() {
            self.poses[link.0] = Some(pose);
            let main: Vec<PointId> = [point].into_iter().chain(rods.iter().map(|&(.., pin)| pin)).collect();
            let own = self.mechanism.link(link).points.clone();
            for p in own {
                let own = self.own(link, p);
                let at = self.carried_point(link, own).value();
                if let Some(miss) = self.miss_of_hint(p, at) {
                    if main.contains(&p) { joints[i] += miss } else { beside[i] += miss }
                }
                if p == point {
                    let origin = self.origin_of_space().map(|g| g.value);
                    shown[i] = [0, 1].map(|k| origin[k] + at[k] * per_mm);
                }
            }
            for &(rod, base, pin) in rods {
                let own = self.own(link, pin);
                let ends = ((base, self.at(base)), (pin, self.carried_point(link, own)));
                for p in self.mechanism.link(rod).points.clone() {
                    if p == base || p == pin || self.hint_of(p).is_none() {
                        continue;
                    }
                    let at = self.corner(rod, ends.0, ends.1, p).value();
                    beside[i] += self.miss_of_hint(p, at).into_iter().sum::<f64>();
                }
            }
        }
        self.poses[link.0] = before;
        let [first, second] = shown;
        chosen(joints).or_else(|| chosen(beside)).ok_or(DrawError::Ambiguous { pin: point, first, second })
    }

    /// A direction of a figure turned as another one of it is turned.
    pub(super) fn turned_with(&mut self, own: Direction, from: Direction, to: Direction) -> Direction {
        let turn = self.board.angle_between(from, own);
        self.board.turned(to, turn)
    }

    /// A direction of a driven link's own figure, and where it points on the skeleton; none where nothing says it.
    pub(super) fn bar_direction(
        &mut self,
        link: LinkId,
        input: Drive,
    ) -> Result<(Direction, Direction), DrawError> {
        let placed: Vec<PointId> =
            self.mechanism.link(link).points.clone().into_iter().filter(|&p| self.prick_given(p)).collect();
        if self.stands_in_world(link) {
            let x = self.board.rightward();
            return Ok((x, x));
        }
        if let Some(angle) = self.driven_angle(input) {
            return Ok((self.own_line_of(link), self.board.protractor(angle)));
        }
        let &[p, .., q] = placed.as_slice() else {
            return Err(DrawError::Missing(Missing::Pose(link)));
        };
        let reason = self.reason(&[link]);
        let (own_from, own_to) = (self.own(link, p), self.own(link, q));
        let (own_along, _) = self.board.toward(own_from, own_to, reason);
        let (from, to) = (self.at(p), self.at(q));
        Ok((own_along, self.board.toward(from, to, reason).0))
    }

    /// The direction of a link's first-to-second line in its own figure; of a link of one joint, that of its x-axis.
    pub(super) fn own_line_of(&mut self, link: LinkId) -> Direction {
        let &[first, second, ..] = self.mechanism.link(link).joints() else {
            return self.board.rightward();
        };
        let (a, b) = (self.own(link, first), self.own(link, second));
        let reason = self.reason(&[link]);
        self.board.toward(a, b, reason).0
    }

    /// A rack or a wheel that rolls from where it is placed: rolling says nothing of where it began.
    fn must_be_placed(&mut self, link: LinkId) -> Result<(), DrawError> {
        let points = self.mechanism.link(link).points.clone();
        let mut placed = false;
        for &point in &points {
            placed |= self.prick_given(point);
        }
        self.act(Act::MarkPlaces);
        match points.first() {
            Some(&point) if !placed && self.pose_of(link).is_none() => Err(DrawError::NotPlaced { point }),
            _ => Ok(()),
        }
    }

    /// A rack on a solved wheel.
    fn rack(&mut self, step: &GroupStep, link: LinkId, roll: usize) -> Result<(), DrawError> {
        self.board.purpose("rack");
        self.must_be_placed(link)?;
        self.transfer_by_pose(step, link);
        self.contact(link, roll);
        Ok(())
    }

    /// A driven wheel: from its placed centre, along the angle of its input where that is given.
    fn driven_wheel(
        &mut self,
        step: &GroupStep,
        (wheel, centre): (LinkId, PointId),
        roll: usize,
        input: Drive,
    ) -> Result<(), DrawError> {
        self.board.purpose("driven wheel");
        if !self.prick_given(centre) {
            match self.place_by_places(centre) {
                Some(at) => self.place(centre, at),
                None => return Err(DrawError::NotPlaced { point: centre }),
            }
        }
        self.act(Act::MarkPlaces);
        match (self.driven_angle(input), self.mechanism.link(wheel).joints().len()) {
            (Some(angle), 2..) => {
                let along = self.board.protractor(angle);
                self.driver_along(step, wheel, centre, along);
                self.contact(wheel, roll);
            }
            _ => self.wheel(step, wheel, centre, roll)?,
        }
        Ok(())
    }

    /// A wheel about its known centre.
    fn wheel(
        &mut self,
        step: &GroupStep,
        wheel: LinkId,
        centre: PointId,
        roll: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("contact point");
        if !self.starts.is_empty() {
            self.roll_on(step, wheel, centre, roll);
            self.contact(wheel, roll);
            return Ok(());
        }
        self.wheel_points(step, wheel, centre);
        if matches!(self.mechanism.link(wheel).form, Form::Single) && self.carries_guide(wheel) {
            self.one_joint_link(wheel, centre)?;
        }
        self.contact(wheel, roll);
        Ok(())
    }

    /// A planet on its arm: its centre is placed, for rolling says nothing of where it began.
    fn planet(
        &mut self,
        step: &GroupStep,
        (arm, base): (LinkId, PointId),
        (wheel, centre): (LinkId, PointId),
        rolls: [usize; 2],
    ) -> Result<(), DrawError> {
        self.board.purpose("planet on its arm");
        if !self.prick_given(centre) {
            let Some(at) = self.place_by_places(centre) else {
                return Err(DrawError::NotPlaced { point: centre });
            };
            self.place(centre, at);
        }
        self.act(Act::MarkPlaces);
        self.transfer_points(step, &[(arm, base)], centre);
        self.wheel(step, wheel, centre, rolls[0])?;
        self.contact(wheel, rolls[1]);
        Ok(())
    }

    /// The contact point of a rolling pair: on the line of centres, or the foot of the centre on the line.
    pub(super) fn contact(&mut self, wheel: LinkId, roll: usize) {
        self.board.purpose("contact point");
        let contact = self.contact_of(roll);
        let scale = self.length_scale();
        let at = match self.mechanism.rolls[roll] {
            Roll::Circles { centres, radii, internal, .. } => {
                let [a, b] = centres.map(|c| self.at(c));
                let reason = self.reason(&[wheel]);
                let (along, _) = self.board.toward(a, b, reason);
                let radius = self.board.amount(radii[0]);
                let mm = self.board.to_paper(radius, scale);
                // Inside a ring the contact lies beyond the smaller circle's centre.
                let ring_is_second = internal && radii[1].value > radii[0].value;
                let outward = if ring_is_second { self.board.reverse(along) } else { along };
                self.board.lay_off(a, outward, mm)
            }
            Roll::Line { guide, centre, .. } => {
                let line = self.line_of(&guide);
                let at = self.at(centre);
                let [along, _] = self.board.square_off(line, at);
                self.board.lay_off(line.through, line.along, along)
            }
        };
        self.place(contact, at);
        if !self.has_marked(contact) {
            self.act(Act::MarkContact { contact });
        }
    }

    /// The further points of a wheel: as placed, or transferred from its centre and a placed one.
    fn wheel_points(&mut self, step: &GroupStep, wheel: LinkId, centre: PointId) {
        let points = &self.mechanism.link(wheel).points;
        let placed = points.iter().copied().find(|&p| p != centre && self.is_given(p));
        for &(link, point) in &step.points {
            if self.prick_given(point) {
                continue;
            }
            if link != wheel {
                // Of the rod at whose end the wheel turns: found with it.
                continue;
            }
            let Some(placed) = placed else {
                // Rolling says nothing of where it began; a given angle does.
                match self.place_by_places(point) {
                    Some(at) => self.place(point, at),
                    None => {
                        self.miss_of(Missing::Place(point));
                    }
                }
                continue;
            };
            self.prick_given(placed);
            let (from, to) = (self.at(centre), self.at(placed));
            let at = self.corner(wheel, (centre, from), (placed, to), point);
            self.place(point, at);
            self.act(Act::TransferPoint { link, point });
        }
    }

    /// A point of a driven link whose first-to-second line points `along`.
    fn lay_off_driven(
        &mut self,
        link: LinkId,
        (first, second): (PointId, PointId),
        base: PointId,
        point: PointId,
        (from, along): (Point, Direction),
    ) -> Point {
        let scale = self.length_scale();
        let joints = [base, point].map(|p| p == first || p == second);
        if joints == [true; 2] && matches!(self.mechanism.link(link).form, Form::Length(_)) {
            let length = self.length(link, base, point);
            let mm = self.board.to_paper(length, scale);
            let outward = if base == first { along } else { self.board.reverse(along) };
            return self.board.lay_off(from, outward, mm);
        }
        // With the set square along the first-to-second line of the link's own figure.
        let (a, b) = (self.own(link, first), self.own(link, second));
        let reason = self.reason(&[link]);
        let (own_along, _) = self.board.toward(a, b, reason);
        let (start, end) = (self.own(link, base), self.own(link, point));
        let [forward, left] = self.board.square_off(Line { through: start, along: own_along }, end);
        let foot = self.board.lay_off(from, along, forward);
        if self.is_straight(link) {
            return foot;
        }
        let square = self.board.quarter_turn(along);
        self.board.lay_off(foot, square, left)
    }

    /// Two arcs about the known pins (compass).
    fn rrr(
        &mut self,
        step: &GroupStep,
        links: [LinkId; 2],
        bases: [PointId; 2],
        pin: PointId,
    ) -> Result<(), DrawError> {
        self.board.purpose("pin by two arcs");
        let main = [(links[0], bases[0]), (links[1], bases[1])];
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
            self.transfer_points(step, &main, pin);
            return Ok(());
        }
        let circles = [self.circle(main[0], pin), self.circle(main[1], pin)];
        let reason = self.reason(&links);
        let pair = self.board.meet_circles(circles[0], circles[1], reason).map_err(|_| {
            let names = bases.map(|b| self.mechanism.point(b).name.clone());
            let [p, q] = bases.map(|b| self.at(b).value());
            let [r1, r2] = circles.map(|c| c.radius.value() * self.scales.length());
            let [first, second] = names;
            DrawError::CannotAssemble {
                pin,
                why: Box::new(Misfit {
                    first: (first, r1),
                    second: (second, Some(r2)),
                    pin: self.mechanism.point(pin).name.clone(),
                    distance: libm::hypot(p[0] - q[0], p[1] - q[1]) * self.scales.length(),
                }),
                range: None,
            }
        })?;
        for ((_, base), circle) in main.iter().zip(circles) {
            let radius = circle.radius.value() * self.scales.length();
            self.act(Act::StrikeArc { centre: *base, to: pin, radius });
        }
        self.take_hinted(&main, None, pin, pair)?;
        let at = self.at(pin).value();
        let index = self.step_index();
        for circle in circles {
            let (centre, radius) = (circle.centre.value(), circle.radius.value());
            self.space_line(ConstructionLine::Arc { centre, radius, at, step: index });
        }
        self.transfer_points(step, &main, pin);
        Ok(())
    }

    /// An arc about the known pin, and the guide.
    fn rrp(
        &mut self,
        step: &GroupStep,
        (rod, base): (LinkId, PointId),
        pin: PointId,
        (slide, rider): (usize, Option<LinkId>),
    ) -> Result<(), DrawError> {
        self.board.purpose("pin by arc and guide");
        let main = [(rod, base)];
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
            self.transfer_points(step, &main, pin);
            self.ride_along(step, slide, rider, pin);
            return Ok(());
        }
        let track = self.riding_track(slide, rider, pin);
        let circle = self.circle(main[0], pin);
        let met = self.meet_track(track, circle, (rod, base), (slide, pin));
        // Where the arc only touches the guide, a further place tells better how the rod stands.
        let points = self.mechanism.link(rod).points.clone();
        let placed = points.into_iter().find(|&p| p != base && p != pin && self.given_place(p).is_some());
        if let Some(far) = placed.filter(|_| self.may_touch(&met, track, circle)) {
            self.prick_given(far);
            self.pose_by_points(rod, base, far);
            let own = self.own(rod, pin);
            let at = self.carried_point(rod, own);
            self.place(pin, at);
            self.act(Act::MarkPlaces);
            self.transfer_points(step, &main, pin);
            self.ride_along(step, slide, rider, pin);
            return Ok(());
        }
        let pair = met?;
        self.act(Act::DrawGuide { slide });
        let radius = circle.radius.value() * self.scales.length();
        self.act(Act::StrikeArc { centre: base, to: pin, radius });
        self.take_hinted(&main, rider.map(|link| (slide, link)), pin, pair)?;
        let at = self.at(pin).value();
        let index = self.step_index();
        let (centre, radius) = (circle.centre.value(), circle.radius.value());
        self.space_line(ConstructionLine::Arc { centre, radius, at, step: index });
        self.space_line(match track {
            Track::Straight(line) => ConstructionLine::Ray {
                from: line.through.value(),
                to: at,
                claim: Some(Claim::Parallel(Reference::Guide(slide))),
                step: index,
            },
            Track::Arc(arc) => ConstructionLine::Arc {
                centre: arc.centre.value(),
                radius: arc.radius.value(),
                at,
                step: index,
            },
        });
        self.transfer_points(step, &main, pin);
        self.ride_along(step, slide, rider, pin);
        Ok(())
    }

    /// Where an arc about a base meets a guide.
    fn meet_track(
        &mut self,
        track: Track,
        circle: Circle,
        (link, base): (LinkId, PointId),
        (slide, pin): (usize, PointId),
    ) -> Result<Pair, DrawError> {
        let reason = self.reason(&[link, self.mechanism.slides[slide].guide.link]);
        let per_mm = self.scales.length();
        let first = (self.mechanism.point(base).name.clone(), circle.radius.value() * per_mm);
        let pin_name = self.mechanism.point(pin).name.clone();
        let (met, second, distance) = match track {
            Track::Straight(line) => {
                let [_, across] = self.board.square_off(line, circle.centre);
                let met = self.board.meet_line_circle(line, circle, reason);
                (met, (String::new(), None), across.value().abs())
            }
            Track::Arc(arc) => {
                let [dx, dy] = self.board.between(circle.centre, arc.centre).map(|d| d.value());
                let met = self.board.meet_circles(circle, arc, reason);
                let second = ("centre of the guide-".to_owned(), Some(arc.radius.value() * per_mm));
                (met, second, libm::hypot(dx, dy))
            }
        };
        met.map_err(|_| DrawError::CannotAssemble {
            pin,
            why: Box::new(Misfit { first, second, pin: pin_name, distance: distance * per_mm }),
            range: None,
        })
    }

    /// A lever whose guide must pass through a pin that stands already: in the lever's own figure an arc
    /// about its base, with the distance of the pin, meets the guide; then the figure is laid on.
    pub(super) fn rpr(
        &mut self,
        step: &GroupStep,
        lever: LinkId,
        base: PointId,
        pin: PointId,
        slide: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("lever through a pin");
        // Of a rider of placed points its first joint stands on the guide, wherever the pin is.
        let pin = match self.mechanism.slides[slide].rider {
            Rider::Link { link, turned: None } => match self.mechanism.link(link).points.first() {
                Some(&first) => {
                    self.prick_given(first);
                    first
                }
                None => return Err(DrawError::Missing(Missing::Joint(link))),
            },
            _ => pin,
        };
        let (at_base, at_pin) = (self.at(base), self.at(pin));
        let reason = self.reason(&[lever]);
        let (along, distance) = self.board.toward(at_base, at_pin, reason);
        self.act(Act::DrawGuide { slide });
        let own_anchor = self.own(lever, base);
        // A rod that stands by a place of its own directs the lever.
        let by_rod = match self.mechanism.slides[slide].rider {
            Rider::Link { link: rod, turned: Some(_) } => {
                let further = |p: &&PointId| **p != pin && !self.mechanism.is_fixed(**p);
                let mut points = self.mechanism.link(rod).points.iter().filter(further);
                // A place that is a hint while the group is tried directs nothing.
                let placed = points.any(|p| self.is_given(*p) && !self.tried.points.contains(p));
                if placed && self.pose_of(rod).is_some() {
                    Some(self.ride_directions(slide, lever))
                } else {
                    None
                }
            }
            _ => None,
        };
        if self.stands_in_world(lever) {
            self.poses[lever.0] =
                Some(Pose { own_anchor: at_base, anchor: at_base, own_along: along, along });
        } else if let Some((own_along, along)) = by_rod {
            self.poses[lever.0] = Some(Pose { own_anchor, anchor: at_base, own_along, along });
        } else if matches!(self.mechanism.link(lever).form, Form::Single) {
            if self.swivels_on(lever, slide) {
                let track = self.own_track(slide, Some(pin));
                self.swivel(lever, (base, track), (slide, pin), at_pin)?;
            } else {
                self.one_joint_link(lever, base)?;
            }
        } else {
            let track = self.own_track(slide, Some(pin));
            let circle = Circle { centre: own_anchor, radius: distance };
            let met = self.meet_track(track, circle, (lever, base), (slide, pin));
            let points = self.mechanism.link(lever).points.clone();
            let placed = points.into_iter().find(|&p| p != base && self.given_place(p).is_some());
            match (met, placed) {
                // Where the pin is nearest to its base on the guide, a further place tells the lever's direction better.
                (met, Some(far)) if self.may_touch(&met, track, circle) => {
                    self.prick_given(far);
                    self.pose_by_points(lever, base, far);
                    self.act(Act::MarkPlaces);
                }
                (met, None)
                    if self.stated_on(lever, base).is_some() && self.may_touch(&met, track, circle) =>
                {
                    // So does a stated one, though dimensions hold it as well.
                    if let Some((far, stated)) = self.stated_on(lever, base) {
                        let own_far = self.own(lever, far);
                        let (own_along, _) = self.board.toward(own_anchor, own_far, reason);
                        let (along, _) = self.board.toward(at_base, stated, reason);
                        self.poses[lever.0] = Some(Pose { own_anchor, anchor: at_base, own_along, along });
                    }
                }
                (met, _) => {
                    let pair = met?;
                    let side = if pair.tangent {
                        Side::First
                    } else {
                        self.choose_lever(lever, (own_anchor, at_base), along, pin, pair)?
                    };
                    let own_pin = self.board.take(pair, side);
                    let (own_along, _) = self.board.toward(own_anchor, own_pin, reason);
                    self.poses[lever.0] = Some(Pose { own_anchor, anchor: at_base, own_along, along });
                }
            }
        }
        self.transfer_by_pose(step, lever);
        Ok(())
    }

    /// A point of a link besides its base that is stated where dimensions and guides hold it, with the stated place.
    fn stated_on(&self, link: LinkId, base: PointId) -> Option<(PointId, Point)> {
        let points = self.mechanism.link(link).points.iter().copied().filter(|&p| p != base);
        points.into_iter().find_map(|p| Some((p, self.stated_hints[p.0]?)))
    }

    /// Chooses between the two ways in which a lever's guide can pass through a pin.
    fn choose_lever(
        &mut self,
        lever: LinkId,
        (own_anchor, anchor): (Point, Point),
        along: Direction,
        pin: PointId,
        pair: Pair,
    ) -> Result<Side, DrawError> {
        let reason = self.reason(&[lever]);
        let poses = [Side::First, Side::Second].map(|side| {
            let own_pin = self.board.take(pair, side);
            let (own_along, _) = self.board.toward(own_anchor, own_pin, reason);
            Pose { own_anchor, anchor, own_along, along }
        });
        let side = self.choose_pose(lever, poses, pin)?;
        self.chosen(usize::from(side == Side::Second));
        Ok(side)
    }

    /// Chooses between two poses of a link by the hints for its points.
    fn choose_pose(&mut self, link: LinkId, poses: [Pose; 2], pin: PointId) -> Result<Side, DrawError> {
        let side = self.right_pose(link, poses, pin)?;
        Ok(if self.takes_other_pose(link) { side.other() } else { side })
    }

    fn right_pose(&mut self, link: LinkId, poses: [Pose; 2], pin: PointId) -> Result<Side, DrawError> {
        let prescribed = self.prescribed_side();
        if let Some(side) = self.side_as_given(link, poses).or(prescribed) {
            return Ok(side);
        }
        let tried = poses.map(|pose| self.hints_of_pose(link, pose));
        match tried.map(|(score, _)| score) {
            [Some(a), Some(b)] if chooses(a, b, self.scales.length()) => Ok(Side::First),
            [Some(a), Some(b)] if chooses(b, a, self.scales.length()) => Ok(Side::Second),
            // A lever of which nothing else is named stands with its guide towards the pin.
            [None, None] if tried[0].1.is_none() => Ok(Side::First),
            _ => match tried.map(|(_, shown)| shown) {
                [Some((_, first)), Some((named, second))] => {
                    Err(DrawError::Ambiguous { pin: named, first, second })
                }
                _ => Err(DrawError::Missing(Missing::Place(pin))),
            },
        }
    }

    /// The pose in which a link has its points where they are given, where their places tell the two apart: a trial may
    /// prescribe the other one, in which nothing shows on the skeleton but the link's guides.
    fn side_as_given(&mut self, link: LinkId, poses: [Pose; 2]) -> Option<Side> {
        let points = self.mechanism.link(link).points.clone();
        let given: Vec<(PointId, Point)> =
            points.into_iter().filter_map(|p| Some((p, self.given_place(p)?))).collect();
        // Its pivot alone stands there in both, and a pencil's width would tell them apart.
        if given.len() < 2 {
            return None;
        }
        let per_mm = self.scales.length();
        let before = self.poses[link.0];
        let [first, second] = poses.map(|pose| {
            self.poses[link.0] = Some(pose);
            let square = |(point, at): &(PointId, Point)| {
                let own = self.own(link, *point);
                let carried = self.carried_point(link, own);
                let [x, y] = self.board.between(*at, carried).map(|mm| mm.value() * per_mm);
                x * x + y * y
            };
            given.iter().map(square).sum::<f64>()
        });
        self.poses[link.0] = before;
        if chooses(first, second, per_mm) {
            Some(Side::First)
        } else {
            chooses(second, first, per_mm).then_some(Side::Second)
        }
    }

    /// How far the points of a link would stand from their hints (square metres), and where one of them
    /// would stand, if the link stood so.
    pub(super) fn hints_of_pose(
        &mut self,
        link: LinkId,
        pose: Pose,
    ) -> (Option<f64>, Option<(PointId, [f64; 2])>) {
        let origin = self.origin_of_space().map(|g| g.value);
        let before = self.poses[link.0].replace(pose);
        let (mut score, mut shown) = (None, None);
        for point in self.mechanism.link(link).points.clone() {
            if self.mechanism.is_fixed(point) || self.places[point.0].is_some() {
                continue;
            }
            let own = self.own(link, point);
            let at = self.carried_point(link, own).value();
            shown = Some((point, [0, 1].map(|k| origin[k] + at[k] * self.scales.length())));
            score = self.miss_of_hint(point, at).map(|m| m + score.unwrap_or(0.0)).or(score);
        }
        self.poses[link.0] = before;
        (score, shown)
    }

    /// Transfers the wanted points of a link whose pose is known.
    pub(super) fn transfer_by_pose(&mut self, step: &GroupStep, link: LinkId) {
        for &(of, point) in &step.points {
            if of != link || self.prick_given(point) {
                continue;
            }
            let own = self.own(link, point);
            let at = self.carried_point(link, own);
            self.place(point, at);
            self.act(Act::TransferPoint { link, point });
        }
    }

    /// The pose of a link that slides without turning against a solved one, and has a known pin.
    fn ride_along(&mut self, step: &GroupStep, slide: usize, link: Option<LinkId>, pin: PointId) {
        let Some(link) = link else { return };
        let own_anchor = self.own(link, pin);
        let anchor = self.at(pin);
        let (own_along, along) = self.ride_directions(slide, link);
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        self.transfer_by_pose(step, link);
    }

    /// A pin on two guides, itself or with links that slide without turning.
    fn prp(
        &mut self,
        step: &GroupStep,
        pin: PointId,
        slides: [usize; 2],
        riders: [Option<LinkId>; 2],
    ) -> Result<(), DrawError> {
        self.board.purpose("pin on two guides");
        if self.prick_given(pin) {
            self.act(Act::MarkPlaces);
        } else {
            let tracks = [0, 1].map(|i| self.riding_track(slides[i], riders[i], pin));
            for slide in slides {
                self.act(Act::DrawGuide { slide });
            }
            self.meet_tracks(tracks, pin, slides)?;
        }
        // One link that rides on both is laid on once.
        let once = usize::from(riders[0].is_none() || riders[0] != riders[1]);
        for (slide, rider) in slides.into_iter().zip(riders).take(1 + once) {
            self.ride_along(step, slide, rider, pin);
        }
        Ok(())
    }

    /// Where two guides meet.
    fn meet_tracks(&mut self, tracks: [Track; 2], pin: PointId, slides: [usize; 2]) -> Result<(), DrawError> {
        let links = slides.map(|slide| self.mechanism.slides[slide].guide.link);
        let reason = self.reason(&links);
        match tracks {
            [Track::Straight(first), Track::Straight(second)] => {
                let meet = self.board.meet_lines(first, second, reason);
                self.place(pin, meet.at);
                self.act(Act::MarkIntersection { point: pin, crossing: meet.crossing });
                Ok(())
            }
            [Track::Arc(arc), other] | [other, Track::Arc(arc)] => {
                let pair = match other {
                    Track::Straight(line) => self.board.meet_line_circle(line, arc, reason),
                    Track::Arc(second) => self.board.meet_circles(arc, second, reason),
                };
                let pair = pair.map_err(|_| self.misses_arc(pin, arc))?;
                self.take_hinted(&[], None, pin, pair)
            }
        }
    }

    fn misses_arc(&self, pin: PointId, arc: Circle) -> DrawError {
        DrawError::CannotAssemble {
            pin,
            why: Box::new(Misfit {
                first: ("radius of the guide-".to_owned(), arc.radius.value() * self.scales.length()),
                second: (String::new(), None),
                pin: self.mechanism.point(pin).name.clone(),
                distance: 0.0,
            }),
            range: None,
        }
    }

    /// Two links whose directions follow from a solved one, by two sliding pairs one after the other. The
    /// pinned one stands by its pin; parallels to both guides meet in a joint of the one between.
    fn rpp(
        &mut self,
        step: &GroupStep,
        (link, point): (LinkId, PointId),
        (lever, base): (LinkId, PointId),
        (ride, slot): (usize, usize),
    ) -> Result<(), DrawError> {
        self.board.purpose("link between two guides");
        // Only the direction counts until the joint is found.
        let (own_anchor, anchor) = (self.own(link, point), self.at(base));
        let (own_along, along) = self.ride_directions(ride, link);
        self.poses[link.0] = Some(Pose { own_anchor, anchor, own_along, along });
        let rides_as_placed = |d: &Self, rider: LinkId| matches!(d.mechanism.slides[slot].rider, Rider::Link { link, turned: None } if link == rider);
        if rides_as_placed(self, link) && !self.stands_in_world(lever) {
            self.rpr(step, lever, base, point, slot)?;
        } else {
            self.ride_along(step, slot, Some(lever), base);
        }
        for slide in [ride, slot] {
            self.act(Act::DrawGuide { slide });
        }
        if self.prick_given(point) {
            self.act(Act::MarkPlaces);
        } else {
            let tracks = [ride, slot].map(|slide| self.riding_track(slide, Some(link), point));
            let [Track::Straight(first), Track::Straight(second)] = tracks else {
                return Err(DrawError::NoConstruction { links: vec![link, lever] });
            };
            let reason = self.reason(&[link, lever]);
            let meet = self.board.meet_lines(first, second, reason);
            self.place(point, meet.at);
            self.act(Act::MarkIntersection { point, crossing: meet.crossing });
        }
        self.ride_along(step, ride, Some(link), point);
        Ok(())
    }

    /// A link that rides without turning, with a slot through a pin that stands already: a parallel to the
    /// slot and the guide meet in its first joint. Of a curved slot the centre runs on a parallel to the
    /// guide, and stands where an arc about the pin meets that.
    fn yoke(
        &mut self,
        step: &GroupStep,
        link: LinkId,
        ride: usize,
        pin: PointId,
        slot: usize,
    ) -> Result<(), DrawError> {
        self.board.purpose("yoke through a pin");
        self.act(Act::DrawGuide { slide: ride });
        self.act(Act::DrawGuide { slide: slot });
        let Some(&first) = self.mechanism.link(link).points.first() else {
            self.miss_of(Missing::Joint(link));
            return Ok(());
        };
        if self.stands_in_world(link) {
            let (anchor, x) = (self.at(pin), self.board.rightward());
            self.poses[link.0] = Some(Pose { own_anchor: anchor, anchor, own_along: x, along: x });
            self.transfer_by_pose(step, link);
            return Ok(());
        }
        // What rides as placed says nothing of how the yoke stands; two of its points that are placed do.
        let as_placed = matches!(self.mechanism.slides[ride].rider, Rider::Link { turned: None, .. });
        let placed = |d: &Self| d.mechanism.link(link).points.iter().filter(|&&p| d.is_given(p)).count() > 1;
        if as_placed && placed(self) && self.pose_of(link).is_some() {
            self.act(Act::MarkPlaces);
            self.transfer_by_pose(step, link);
            return Ok(());
        }
        let Track::Straight(guide) = self.riding_track(ride, Some(link), first) else {
            return Err(DrawError::NoConstruction { links: vec![link] });
        };
        let (own_along, rides) = self.ride_directions(ride, link);
        let own_anchor = self.own(link, first);
        let at_pin = self.at(pin);
        let reason = self.reason(&[link]);
        let pose = |anchor| Some(Pose { own_anchor, anchor, own_along, along: rides });
        // The slot carried over as if the first joint stood at the pin, or at the start of the guide.
        let straight = matches!(self.mechanism.slides[slot].guide.path, Path::Straight { .. });
        self.poses[link.0] = pose(if straight { at_pin } else { guide.through });
        match self.track(slot, Some(pin)) {
            Track::Straight(line) => {
                let [_, across] = self.board.square_off(line, at_pin);
                let left = self.board.quarter_turn(line.along);
                let through = self.board.lay_off(at_pin, left, across);
                let meet = self.board.meet_lines(Line { through, along: line.along }, guide, reason);
                self.poses[link.0] = pose(meet.at);
            }
            Track::Arc(arc) => {
                let centres = Line { through: arc.centre, along: guide.along };
                let about = Circle { centre: at_pin, radius: arc.radius };
                let pair = self.board.meet_line_circle(centres, about, reason);
                let pair = pair.map_err(|_| self.misses_arc(pin, arc))?;
                let poses = [Side::First, Side::Second].map(|side| {
                    let centre = self.board.take(pair, side);
                    let [along, _] = self.board.square_off(centres, centre);
                    let anchor = self.board.lay_off(guide.through, guide.along, along);
                    Pose { own_anchor, anchor, own_along, along: rides }
                });
                let side = if pair.tangent { Side::First } else { self.choose_pose(link, poses, pin)? };
                self.chosen(usize::from(side == Side::Second));
                self.poses[link.0] = Some(poses[usize::from(side == Side::Second)]);
            }
        }
        self.transfer_by_pose(step, link);
        Ok(())
    }

    pub(super) fn circle(&mut self, (link, base): (LinkId, PointId), pin: PointId) -> Circle {
        let length = self.length(link, base, pin);
        let scale = self.length_scale();
        Circle { centre: self.at(base), radius: self.board.to_paper(length, scale) }
    }

    /// Takes the point of a pair that the scene's hints choose.
    pub(super) fn take_hinted(
        &mut self,
        main: &[(LinkId, PointId)],
        rider: Option<(usize, LinkId)>,
        pin: PointId,
        pair: Pair,
    ) -> Result<(), DrawError> {
        let crossing = pair.crossing;
        let mut side = if pair.tangent { Side::First } else { self.choose(main, rider, pin, pair)? };
        if self.takes_other_side(pin) {
            side = side.other();
        }
        self.chosen(usize::from(side == Side::Second));
        let at = self.board.take(pair, side);
        self.place(pin, at);
        self.act(Act::MarkIntersection { point: pin, crossing });
        Ok(())
    }

    fn choose(
        &mut self,
        main: &[(LinkId, PointId)],
        rider: Option<(usize, LinkId)>,
        pin: PointId,
        pair: Pair,
    ) -> Result<Side, DrawError> {
        if let Some(side) = self.prescribed_side() {
            return Ok(side);
        }
        let origin = self.origin_of_space().map(|g| g.value);
        let per_mm = self.scales.length();
        let sides = [Side::First, Side::Second];
        let mut score: [Option<f64>; 2] = [None; 2];
        for (side, score) in sides.iter().zip(&mut score) {
            *score = self.miss_of_hint(pin, self.board.look(&pair, *side));
        }
        let chosen = |score: [Option<f64>; 2]| match score {
            [Some(a), Some(b)] if chooses(a, b, per_mm) => Some(Side::First),
            [Some(a), Some(b)] if chooses(b, a, per_mm) => Some(Side::Second),
            _ => None,
        };
        // The pin's own hint comes first. Where it has none, or lies between both, a hint for another point of its
        // links may still tell.
        let [first, second] = sides.map(|side| self.board.look(&pair, side));
        let apart = libm::hypot(first[0] - second[0], first[1] - second[1]) * per_mm;
        let is_far = matches!(score, [Some(a), Some(b)] if a.min(b).sqrt() > HINT_FAR * apart);
        if chosen(score).is_none() && !is_far {
            score = self.hints_beside(main, rider, pin, pair);
        }
        match chosen(score) {
            Some(side) => Ok(side),
            None => {
                let world = |at: [f64; 2]| [0, 1].map(|k| origin[k] + at[k] * per_mm);
                Err(DrawError::Ambiguous { pin, first: world(first), second: world(second) })
            }
        }
    }

    /// How far the other points of a pin's links would stand from their hints, for each of its two places; square
    /// metres.
    fn hints_beside(
        &mut self,
        main: &[(LinkId, PointId)],
        rider: Option<(usize, LinkId)>,
        pin: PointId,
        pair: Pair,
    ) -> [Option<f64>; 2] {
        let sides = [Side::First, Side::Second];
        let mut score: [Option<f64>; 2] = [None; 2];
        let mut hinted: Vec<(LinkId, PointId, PointId)> = Vec::new();
        for &(link, base) in main {
            for &point in &self.mechanism.link(link).points {
                let known = point == pin || self.places[point.0].is_some();
                if !known && self.hint_of(point).is_some() {
                    hinted.push((link, base, point));
                }
            }
        }
        for (side, score) in sides.iter().zip(&mut score) {
            for &(link, base, point) in &hinted {
                let at_pin = self.board.take(pair, *side);
                let at_base = self.at(base);
                let at = self.corner(link, (base, at_base), (pin, at_pin), point).value();
                if let Some(m) = self.miss_of_hint(point, at) {
                    *score = Some(score.unwrap_or(0.0) + m);
                }
            }
            let Some((slide, link)) = rider else { continue };
            let (own_anchor, anchor) = (self.own(link, pin), self.board.take(pair, *side));
            let (own_along, along) = self.ride_directions(slide, link);
            let carried = self.hints_of_pose(link, Pose { own_anchor, anchor, own_along, along }).0;
            *score = carried.map(|m| m + score.unwrap_or(0.0)).or(*score);
        }
        score
    }

    /// Whether a link carries a guide, or a link that slides without turning, so that its pose will be
    /// needed.
    pub(super) fn carries_guide(&self, link: LinkId) -> bool {
        let slides = self.mechanism.slides.iter().any(|s| {
            s.guide.link == link || matches!(s.rider, Rider::Link { link: rider, .. } if rider == link)
        });
        let rolls = self.mechanism.rolls.iter();
        slides || rolls.into_iter().any(|r| matches!(r, Roll::Line { guide, .. } if guide.link == link))
    }

    /// Transfers the further points of the group that are wanted.
    pub(super) fn transfer_points(&mut self, step: &GroupStep, main: &[(LinkId, PointId)], pin: PointId) {
        for &(link, base) in main {
            if self.carries_guide(link) {
                self.pose_by_points(link, base, pin);
            }
        }
        for &(link, point) in &step.points {
            if self.prick_given(point) {
                continue;
            }
            let Some(&(_, base)) = main.iter().find(|(l, _)| *l == link) else { continue };
            let (from, to) = (self.at(base), self.at(pin));
            let at = self.corner(link, (base, from), (pin, to), point);
            self.place(point, at);
            self.act(Act::TransferPoint { link, point });
        }
    }

    /// A point of a link of which two points stand on the skeleton: lay off its own offsets along the base
    /// and square to it.
    fn corner(
        &mut self,
        link: LinkId,
        (p, at_p): (PointId, Point),
        (q, at_q): (PointId, Point),
        point: PointId,
    ) -> Point {
        let reason = self.reason(&[link]);
        let (along, _) = self.board.toward(at_p, at_q, reason);
        let [forward, left] = self.offsets(link, p, q, point);
        let foot = self.board.step_off(at_p, along, forward);
        if self.is_straight(link) {
            return foot;
        }
        let square = self.board.quarter_turn(along);
        self.board.lay_off(foot, square, left)
    }
}
