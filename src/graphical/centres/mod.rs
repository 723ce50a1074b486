//! Instant centres by the circle diagram (`s000-ch3b` A and B).
//!
//! 1. Mark the primary centres: a pin; at infinity square to a straight guide; the centre of an arc guide; the
//!    contact of a rolling pair. Of a sliding contact the common normal is known.
//! 2. Kennedy: the centres of three links lie on one line. Look for two triangles of the circle diagram that share
//!    one dashed chord and whose other sides are solid; draw both lines of centres; they meet in the sought centre.
//! 3. Go on until the wanted centres are found, and no further.
//!
//! Lines are joined and met in homogeneous coordinates, so that a centre at infinity is as good as any. Where the
//! diagram stalls (complex mechanisms, links driven separately), the centre is taken from the velocity polygon: it lies
//! on the normal to the velocity that a point of one link has seen from the other, at the distance V / ω, both relative
//! to the other.

mod feed;
mod search;
mod velocities;

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};

use crate::board::{Amount, HomogeneousLine, HomogeneousPoint, Location, Point};
use crate::given::Given;
use crate::mechanism::quantity::Order;
use crate::mechanism::structure::TrialDriver;
use crate::mechanism::{Input, LinkId, PointId, Rider, Roll};
use crate::plan::{CentrePlan, GroupStep, Plan, chord};

use super::construction::{Centre, CentrePlace, CircleDiagram, Found};
use super::draughtsman::{Coincident, Draughtsman, Motion};
use super::pose::Track;
pub(super) use feed::draw as feed;
pub use search::CentreLine;
use search::{Atlas, Chord, Derivation};
pub(super) use velocities::{FromCentres, NO_INPUT, Why};

/// The centres that stand on the skeleton.
#[derive(Default)]
pub(super) struct Centres {
    /// By their links.
    pub(super) known: BTreeMap<Chord, HomogeneousPoint>,
    /// Those of links that do not move against each other, as their velocities show: there are none.
    pub(super) still: BTreeSet<Chord>,
    normals: BTreeMap<Chord, (usize, HomogeneousLine)>,
}

/// Draws the circle diagram as far as the wanted centres need it.
pub(super) fn draw(d: &mut Draughtsman<'_>, plan: &Plan) {
    let (velocity, plan) = (plan.steps(Order::Velocity), &plan.centres);
    d.note_circle(CircleDiagram {
        links: (0..d.mechanism.links.len()).map(LinkId).collect(),
        wanted: plan.wanted.iter().copied().collect(),
        centres: Vec::new(),
        stalled: Vec::new(),
        still: Vec::new(),
        transfers: Vec::new(),
    });
    d.board.purpose("instant centres");
    d.primary_centres(plan);
    // What is sought first stalls as it does alone, though what is shown besides would lead to it.
    let mut stalled = plan.first.iter().flat_map(|first| d.seek_centres(first, velocity)).collect::<Vec<_>>();
    stalled.extend(d.seek_centres(plan, velocity));
    d.note_stalled(stalled);
    for (index, asked) in d.mechanism.asked.iter().enumerate().filter(|(_, asked)| asked.by_centres()) {
        d.open_transfer(index, asked.method);
        let found = d.velocity_from_centres(asked.quantity, asked.method);
        d.transferred.push((index, found));
    }
}

/// What is known of the motion of a mechanism that rests.
struct Rest {
    motion: Motion,
    rolling_speeds: Vec<Option<Amount>>,
    coincident: Vec<Coincident>,
    tried_rates: Vec<(Order, TrialDriver, Amount)>,
    parts: usize,
    loud: bool,
}

impl Draughtsman<'_> {
    /// Finds the wanted centres of a plan, by the velocity polygon where the diagram does not lead to them; those that are left.
    fn seek_centres(&mut self, plan: &CentrePlan, velocity: &[GroupStep]) -> Vec<Chord> {
        let mut stalled = self.kennedy(plan);
        if !plan.with_velocities || stalled.is_empty() {
            return stalled;
        }
        let rest = self.rests().then(|| self.assume_motion(velocity));
        // The poles of the stalled centres' links; with them the diagram may go on.
        for &[i, j] in &stalled {
            for link in [i, j].into_iter().filter(|&l| l != LinkId::FRAME) {
                self.centre_by_velocity(chord(LinkId::FRAME, link));
            }
        }
        stalled = self.kennedy(plan);
        stalled.retain(|&stuck| !self.centre_by_velocity(stuck));
        stalled = if stalled.is_empty() { stalled } else { self.kennedy(plan) };
        if let Some(rest) = rest {
            self.rest_again(rest);
        }
        stalled
    }

    /// Whether the only input rests: then nothing moves, and yet its links have centres.
    fn rests(&self) -> bool {
        let [input] = self.mechanism.inputs.as_slice() else { return false };
        let rate = match *input {
            Input::Angle { omega: rate, .. }
            | Input::Speed { speed: rate, .. }
            | Input::Slide { velocity: rate, .. } => rate,
        };
        rate == Given::exact(0.0)
    }

    /// Draws the velocity polygon aside with an assumed rate of the input.
    fn assume_motion(&mut self, steps: &[GroupStep]) -> Rest {
        let rest = Rest {
            motion: self.motion(Order::Velocity).clone(),
            rolling_speeds: self.rolling_speeds.clone(),
            coincident: std::mem::take(&mut self.coincident),
            tried_rates: std::mem::take(&mut self.tried_rates),
            parts: self.parts.len(),
            loud: !std::mem::replace(&mut self.silent, true),
        };
        self.assumed_rate = Some(Given::exact(1.0));
        // What is known of the motion at rest is not known of this one.
        let mechanism = self.mechanism;
        let motion = self.motion_mut(Order::Velocity);
        let moves = |&(index, _): &(usize, &mut Option<Point>)| !mechanism.is_fixed(PointId(index));
        motion.images.iter_mut().enumerate().filter(moves).for_each(|(_, image)| *image = None);
        motion.rotations.iter_mut().skip(1).for_each(|rate| *rate = None);
        motion.slidings.fill(None);
        for step in steps {
            self.velocity_of(step, &self.structure.groups[step.group]);
        }
        rest
    }

    /// Rubs that polygon out again.
    fn rest_again(&mut self, rest: Rest) {
        *self.motion_mut(Order::Velocity) = rest.motion;
        (self.rolling_speeds, self.coincident) = (rest.rolling_speeds, rest.coincident);
        self.tried_rates = rest.tried_rates;
        self.parts.truncate(rest.parts);
        self.silent = !rest.loud;
        self.assumed_rate = None;
    }

    /// Marks the centres that are seen from the pairs.
    fn primary_centres(&mut self, plan: &CentrePlan) {
        // Where the whole skeleton stands every pair is seen, whether a wanted centre needs it or not.
        let whole = self.places.iter().all(Option::is_some);
        let needed = |c: &Chord| c.iter().all(|l| plan.links.contains(l));
        let takes_part = |c: &Chord| (whole || needed(c)) && !plan.barred.contains(c);
        for index in 0..self.mechanism.points.len() {
            let (point, links) = (PointId(index), &self.mechanism.points[index].links);
            let Some(at) = self.places[index] else { continue };
            for (n, &i) in links.iter().enumerate() {
                for &j in links[n + 1..].iter().filter(|&&j| takes_part(&chord(i, j))) {
                    let centre = self.board.proper(at);
                    self.centre_found(chord(i, j), centre, Found::Pin(point));
                }
            }
        }
        for slide in 0..self.mechanism.slides.len() {
            let guide = self.mechanism.slides[slide].guide.link;
            match self.mechanism.slides[slide].rider {
                Rider::Pin { block: Some(link), point } => {
                    if takes_part(&chord(link, guide)) {
                        self.centre_of_guide(slide, chord(link, guide), point);
                    }
                }
                Rider::Link { link, .. } => {
                    if let (true, Some(&first)) =
                        (takes_part(&chord(link, guide)), self.mechanism.link(link).points.first())
                    {
                        self.centre_of_guide(slide, chord(link, guide), first);
                    }
                }
                Rider::Pin { block: None, point } => {
                    for link in self.mechanism.point(point).links.clone() {
                        if link != guide && needed(&chord(link, guide)) && takes_part(&chord(link, guide)) {
                            self.normal_of_contact(slide, chord(link, guide), point);
                        }
                    }
                }
            }
        }
        for roll in 0..self.mechanism.rolls.len() {
            let links = self.mechanism.rolls[roll].bodies();
            let links = chord(links[0], links[1]);
            if let (true, Some(at)) = (takes_part(&links), self.pitch_point(roll)) {
                let centre = self.board.proper(at);
                self.centre_found(links, centre, Found::Rolling { roll });
            }
        }
    }

    /// Where two bodies roll: of wheels the point that divides the line of their centres as their radii, from which
    /// a contact drawn by one radius alone may be off by as much as the stated distance of the centres is.
    fn pitch_point(&mut self, roll: usize) -> Option<Point> {
        let contact = self.places[self.mechanism.contacts[roll].0]?;
        let Roll::Circles { links, centres, radii, internal } = self.mechanism.rolls[roll] else {
            return Some(contact);
        };
        let [Some(first), Some(second)] = centres.map(|centre| self.places[centre.0]) else {
            return Some(contact);
        };
        let [own, other] = radii.map(|radius| self.board.amount(radius));
        let whole = if internal { self.board.difference(own, other) } else { self.board.sum(own, other) };
        let scale = self.length_scale();
        let (part, whole) = (self.board.to_paper(own, scale), self.board.to_paper(whole, scale));
        let reason = self.reason(&links);
        let ratio = self.board.ratio(part, whole, reason);
        Some(self.board.divide(first, second, ratio))
    }

    /// A block on a straight guide: at infinity on any perpendicular; on an arc: the centre of curvature.
    fn centre_of_guide(&mut self, slide: usize, links: Chord, rider: PointId) {
        match self.track(slide, Some(rider)) {
            Track::Straight(line) => {
                let across = self.board.quarter_turn(line.along);
                let centre = self.board.at_infinity(across);
                self.centre_found(links, centre, Found::Guide { slide });
            }
            Track::Arc(circle) => {
                let centre = self.board.proper(circle.centre);
                self.centre_found(links, centre, Found::ArcGuide { slide });
            }
        }
    }

    /// A pin in a bare slot: the centre lies on the common normal.
    fn normal_of_contact(&mut self, slide: usize, links: Chord, pin: PointId) {
        let (along, _) = self.tangent(slide, pin);
        let normal = self.board.quarter_turn(along);
        let through = self.at(pin);
        let line = self.board.extended(crate::board::Line { through, along: normal });
        self.centres.normals.entry(links).or_insert((slide, line));
    }

    /// Notes a centre, unless an earlier pair has shown it.
    fn centre_found(&mut self, links: Chord, centre: HomogeneousPoint, found: Found) {
        if self.centres.known.contains_key(&links) {
            return;
        }
        self.centres.known.insert(links, centre);
        let reason = self.reason(&links);
        let place = match self.board.locate(centre, reason) {
            Location::At(point) => CentrePlace::At(point.value()),
            Location::Toward(direction, _) => CentrePlace::Toward(direction.value()),
        };
        self.note_centre(Centre { links, place, found });
    }

    /// Kennedy's theorem until all wanted centres are found; returns those at which the diagram stalls.
    fn kennedy(&mut self, plan: &CentrePlan) -> Vec<Chord> {
        let mut atlas = Atlas {
            links: plan.links.iter().copied().collect(),
            left: Cell::new(search::ALL_LOOKS),
            ..Atlas::default()
        };
        atlas.normals =
            self.centres.normals.iter().map(|(c, (slide, line))| (*c, (*slide, line.look()))).collect();
        let mut wanted: Vec<Chord> = plan.wanted.iter().copied().collect();
        let mut stalled = Vec::new();
        loop {
            wanted.retain(|c| !self.centres.known.contains_key(c));
            if wanted.is_empty() {
                return stalled;
            }
            atlas.points = self.centres.known.iter().map(|(c, p)| (*c, p.look())).collect();
            match atlas.order(&wanted) {
                Some(order) => {
                    // A derivation whose lines coincide is no failure of the method: others are taken.
                    let blocked =
                        order.into_iter().find(|&derivation| !self.meet_lines_of_centres(derivation));
                    if let Some(blocked) = blocked {
                        atlas.refused.insert(blocked);
                    }
                }
                None => {
                    let reached = atlas.reached(&wanted);
                    let (open, stuck): (Vec<Chord>, Vec<Chord>) =
                        wanted.iter().partition(|c| reached.contains(*c));
                    stalled.extend(stuck);
                    wanted = open;
                }
            }
        }
    }

    /// Draws two lines of centres and marks where they meet; false where they coincide.
    fn meet_lines_of_centres(&mut self, derivation: Derivation) -> bool {
        let Derivation { chord: links, lines } = derivation;
        let [first, second] = lines.map(|line| self.line_of_centres(links, line));
        let (Some(first), Some(second)) = (first, second) else { return false };
        let Some(centre) = self.board.cross_lines(first, second) else { return false };
        self.centre_found(links, centre, Found::Kennedy { lines });
        true
    }

    /// The line of the centres (i k) and (k j), or the common normal of i and j.
    fn line_of_centres(&mut self, links: Chord, line: CentreLine) -> Option<HomogeneousLine> {
        match line {
            CentreLine::Normal(_) => self.centres.normals.get(&links).map(|(_, line)| *line),
            CentreLine::Via(k) => {
                let ends = links.map(|l| self.centres.known.get(&chord(l, k)).copied());
                let [Some(p), Some(q)] = ends else { return None };
                self.board.join(p, q)
            }
        }
    }

    /// A centre from the velocity polygon: on the normal to the velocity of a point of one link seen from the other, at
    /// the distance V / ω. False where no point's velocity is known in both, and where neither link moves against the
    /// other.
    fn centre_by_velocity(&mut self, links: Chord) -> bool {
        if self.centres.known.contains_key(&links) {
            return true;
        }
        let [i, j] = links;
        // The frame carries no arrow: its points are seen from the other link's.
        let ways = [[j, i], [i, j]];
        let known = ways.into_iter().find_map(|[link, from]| {
            let point = self.point_of_velocity(link, from)?;
            Some((link, from, point))
        });
        let seen = known.or_else(|| {
            ways.into_iter().find_map(|[link, from]| {
                let point = self.point_to_be_seen(link, from)?;
                Some((link, from, point))
            })
        });
        let Some((link, from, point)) = seen else { return false };
        let rates = [link, from].map(|l| {
            if l == LinkId::FRAME { Some(self.rest()) } else { self.motion(Order::Velocity).rotations[l.0] }
        });
        let [Some(own), Some(other)] = rates else { return false };
        if from != LinkId::FRAME && !self.mechanism.link(from).points.contains(&point) {
            self.step(Order::Velocity, &[from], Vec::new());
        }
        let under = self.image_under(Order::Velocity, point, from);
        let image = self.image(Order::Velocity, point);
        self.board.purpose("instant centres");
        let (paper, scale) = (self.polygon_scale(Order::Velocity), self.length_scale());
        let velocity = self.board.between(under, image).map(|mm| self.board.read(mm, paper));
        let omega = self.board.difference(own, other);
        let at = self.at(point);
        let Some(centre) = self.board.on_normal(at, velocity, omega, scale) else {
            self.centres.still.insert(links);
            return false;
        };
        self.centre_found(
            links,
            centre,
            Found::Normal { point, link, from, assumed: self.assumed_rate.is_some() },
        );
        true
    }

    /// A point of a link that stands on the skeleton and whose velocity is known, where that of the other link's point
    /// under it is known as well or can be laid off.
    fn point_of_velocity(&self, link: LinkId, from: LinkId) -> Option<PointId> {
        if link == LinkId::FRAME || from != LinkId::FRAME && self.point_with_image(from).is_none() {
            return None;
        }
        self.point_with_image(link)
    }

    /// A point of a link that stands on the skeleton and whose velocity is known.
    fn point_with_image(&self, link: LinkId) -> Option<PointId> {
        let known = |p: PointId| {
            self.places[p.0].is_some()
                && (self.mechanism.is_fixed(p) || self.motion(Order::Velocity).images[p.0].is_some())
        };
        self.mechanism.link(link).points.iter().copied().find(|&p| known(p))
    }

    /// The same where of one link, or of both, only a point under the pin is known by which it was solved: from there the
    /// velocity of the link's first joint is laid off.
    fn point_to_be_seen(&mut self, link: LinkId, from: LinkId) -> Option<PointId> {
        let solved =
            |d: &Self, l: LinkId| d.coincident.iter().any(|c| c.order == Order::Velocity && c.link == l);
        let carries = from == LinkId::FRAME || self.point_with_image(from).is_some() || solved(self, from);
        if link == LinkId::FRAME || !carries {
            return None;
        }
        let known = self.point_with_image(link);
        if known.is_some() || !solved(self, link) {
            return known;
        }
        let point = self.mechanism.link(link).points.iter().copied().find(|p| self.places[p.0].is_some())?;
        self.step(Order::Velocity, &[link], Vec::new());
        self.board.purpose("velocity image of a further point");
        let image = self.translated_image(Order::Velocity, link, point);
        let image = self.note_image(Order::Velocity, point, image);
        self.absolute_of(Order::Velocity, point, image);
        Some(point)
    }
}
