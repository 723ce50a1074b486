//! Centrodes: the loci of an instant centre in both of its links while the input runs through its range.
//!
//! Each position is drawn by the same constructions as the skeleton, on a board without a memory; the assembly
//! is continued from position to position by the nearest places. The loci are kept in homogeneous coordinates, so that
//! a centre that runs through infinity breaks its curve there, with the direction of the asymptote.

use crate::board::Board;
use crate::given::Given;
use crate::mechanism::quantity::{Asked, Method, Quantity, Unit};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Form, Input, LinkId, Mechanism, Path, Place, PointId, Rider};
use crate::plan::{CentreSource, Extent, Plan, chord};

use super::{DrawError, Scales, draw, provisional_scales};

/// How fine and how far the loci are followed, metres.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fineness {
    /// No point of a locus lies further from its straight pieces than this.
    pub tolerance: f64,
    /// The loci are followed to this distance from the skeleton's first fixed point.
    pub reach: f64,
}

/// The loci of an instant centre.
#[derive(Debug, Clone, PartialEq)]
pub struct Centrodes {
    /// The links: the locus in the first is called fixed, that in the second moving.
    pub links: [LinkId; 2],
    /// The locus in the first link, as it stands now.
    pub fixed: Vec<Branch>,
    /// The locus in the second link, as it stands now. It rolls on the other without sliding.
    pub moving: Vec<Branch>,
}

/// A connected piece of a locus: metres in the skeleton's frame.
#[derive(Debug, Clone, PartialEq)]
pub struct Branch {
    /// Its points, in the order in which the input runs.
    pub points: Vec<[f64; 2]>,
    /// How it begins and ends.
    pub ends: [BranchEnd; 2],
}

/// How a branch ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum BranchEnd {
    /// In its own beginning.
    Closed,
    /// At a limit of the input's range.
    Limit,
    /// At infinity: unit vector along the asymptote, outward.
    Infinity([f64; 2]),
    /// Further away than the locus is followed; it comes back.
    Reach,
    /// At a position in which the centre is not determined (a change point); it goes on beyond it.
    Gap,
}

/// Why there are no centrodes.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CentrodeError {
    /// A mechanism of several inputs has no one cycle.
    #[error("centrodes need a mechanism with one input")]
    Inputs,
    /// The mechanism cannot be moved on as it is given.
    #[error("a link that rides as placed cannot be moved on")]
    RidesAsPlaced,
    /// The two links share a pin, or do not move against each other.
    #[error("the centre is permanent: its locus is a point")]
    Permanent,
    /// A link with one point whose turning nothing drawn tells.
    #[error("the turning of a link with one point is not drawn")]
    Turning,
    /// The chain opens before the input has come to where it is wanted.
    #[error("the chain opens before the input is there")]
    Range,
    /// The present position cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
}

/// A point of the extended plane: (x, y, w), the point (x, y)/w.
type Homogeneous = [f64; 3];

/// One position of the mechanism.
#[derive(Debug, Clone)]
struct Station {
    input: f64,
    /// Places by point, metres in the skeleton's frame.
    places: Vec<Option<[f64; 2]>>,
    /// The centre as a point of both links, carried to their present positions.
    loci: [Homogeneous; 2],
}

/// The place and the direction of a link.
#[derive(Debug, Clone, Copy)]
struct Frame {
    origin: [f64; 2],
    along: [f64; 2],
}

impl Frame {
    /// A point of the plane in this frame's own coordinates.
    fn own(&self, [x, y, w]: Homogeneous) -> Homogeneous {
        let [dx, dy] = [x - w * self.origin[0], y - w * self.origin[1]];
        let [c, s] = self.along;
        [dx * c + dy * s, dy * c - dx * s, w]
    }

    /// A point of the frame's own coordinates in the plane.
    fn carried(&self, [x, y, w]: Homogeneous) -> Homogeneous {
        let [c, s] = self.along;
        [x * c - y * s + w * self.origin[0], x * s + y * c + w * self.origin[1], w]
    }
}

/// Steps in a whole turn, or in the length of the mechanism, before refinement.
const STEPS: f64 = 240.0;
/// A step that moves a point by more than this part of the mechanism's size is halved.
const LONGEST_MOVE: f64 = 0.08;
/// Halvings of a step, and of an edge of the range.
const HALVINGS: u32 = 40;
/// Halvings of a piece of a locus until it is as straight as wanted.
const REFINEMENTS: u32 = 10;
/// A piece whose middle lies nearer to one of its ends than this part of it is not yet followed closely enough.
const UNEVEN: f64 = 0.05;
/// Turns of the input after which every mechanism that is traced has come back, or is taken as it is.
const MOST_TURNS: usize = 8;

/// The centrodes of two links over the range of the one input, from the present position both ways.
///
/// # Errors
/// See [`CentrodeError`].
pub fn trace(
    mechanism: &Mechanism,
    structure: &Structure,
    links: [LinkId; 2],
    fineness: Fineness,
) -> Result<Centrodes, CentrodeError> {
    let shared = mechanism.points.iter().any(|p| links.iter().all(|l| p.links.contains(l)));
    if shared || links[0] == links[1] {
        return Err(CentrodeError::Permanent);
    }
    let rig = Rig::new(mechanism, structure, links)?;
    let start = rig.present()?;
    let (forward, closed) = rig.run(&start, 1.0);
    let mut stations = forward;
    if !closed {
        let (back, _) = rig.run(&start, -1.0);
        let mut all: Vec<Station> = back.into_iter().skip(1).collect();
        all.reverse();
        all.append(&mut stations);
        stations = all;
    }
    let [fixed, moving] = [0, 1].map(|which| rig.branches(&stations, closed, which, fineness));
    Ok(Centrodes { links, fixed, moving })
}

/// The places of all points, metres in the skeleton's frame, when the one input has come to `to` without leaving the
/// assembly.
///
/// # Errors
/// See [`CentrodeError`]; [`CentrodeError::Range`] where the chain opens on the way.
pub fn places_at(
    mechanism: &Mechanism,
    structure: &Structure,
    link: LinkId,
    to: f64,
) -> Result<Vec<Option<[f64; 2]>>, CentrodeError> {
    let rig = Rig::new(mechanism, structure, [LinkId::FRAME, link])?;
    let mut stations = vec![rig.present()?];
    let whole = rig.whole();
    while let Some(last) = stations.last() {
        let left = to - last.input;
        if left == 0.0 {
            return Ok(last.places.clone());
        }
        let step = left.clamp(-whole / STEPS, whole / STEPS);
        let goal = if step == left { to } else { last.input + step };
        match rig.onward(&stations, goal) {
            Some(station) => stations.push(station),
            None => return Err(CentrodeError::Range),
        }
    }
    Err(CentrodeError::Range)
}

/// Why there are none, as one clause that stands by itself.
#[must_use]
pub fn clause(error: &CentrodeError) -> &'static str {
    match error {
        CentrodeError::Inputs => "the mechanism has more than one input",
        CentrodeError::RidesAsPlaced => "a link that rides as placed cannot be moved on",
        CentrodeError::Permanent => "the centre is permanent: it does not move in either link",
        CentrodeError::Turning => "the turning of a link with one point is not drawn",
        CentrodeError::Range => "the chain opens before the input is there",
        CentrodeError::Draw(_) => "the present position cannot be drawn",
    }
}

/// A mechanism whose input can be turned.
struct Rig<'a> {
    mechanism: Mechanism,
    structure: &'a Structure,
    plan: Plan,
    scales: Scales,
    links: [LinkId; 2],
    input: usize,
    /// What a station's input counts in: radians or metres, and where it stands now.
    now: f64,
    /// World coordinates of the skeleton's origin.
    origin: [f64; 2],
    size: f64,
    /// Present frames of both links.
    present: Option<[Frame; 2]>,
}

impl<'a> Rig<'a> {
    fn new(
        mechanism: &Mechanism,
        structure: &'a Structure,
        links: [LinkId; 2],
    ) -> Result<Self, CentrodeError> {
        let &[input] = mechanism.inputs.as_slice() else { return Err(CentrodeError::Inputs) };
        let mut asking = super::figure::standing(mechanism)?.into_owned();
        let unit = Unit { symbol: String::new(), si: 1.0 };
        let quantity = Quantity::Centre(links[0], links[1]);
        asking.asked = vec![Asked { name: String::new(), quantity, unit, method: Method::default() }];
        let scales = provisional_scales(mechanism);
        let first = |source| Plan::with(&asking, structure, Extent::Asked, source);
        let mut plan = first(CentreSource::Diagram);
        let stalls = position(&asking, structure, &plan, scales, links)?.is_none();
        if stalls {
            plan = first(CentreSource::Velocities);
        }
        // The present places of everything, to release what is placed and to begin from.
        let whole = Plan::with(&asking, structure, Extent::WholeSkeleton, CentreSource::Diagram);
        let board = Board::scratch();
        let drawn = draw(board, &asking, structure, &whole, scales)?;
        let exact = |p: &crate::mechanism::Point| match p.place {
            Place::Fixed(at) => Some(at.map(|g| g.value)),
            _ => None,
        };
        let placed = |p: &crate::mechanism::Point| p.place.exact().map(|at| at.map(|g| g.value));
        let origin = asking.points.iter().find_map(exact);
        let origin = origin.or_else(|| asking.points.iter().find_map(placed)).unwrap_or([0.0; 2]);
        let world = |at: [f64; 2]| [0, 1].map(|k| origin[k] + at[k] * scales.length());
        let places: Vec<Option<[f64; 2]>> =
            drawn.record().space.places.iter().map(|p| p.map(world)).collect();
        let now = match input {
            Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. } => angle.value,
            Input::Slide { at: Some(at), .. } => at.value,
            Input::Angle { link, .. } | Input::Speed { link, .. } => {
                let ends = asking.link(link).points.iter().take(2).map(|p| places[p.0]);
                let ends: Vec<[f64; 2]> = ends.flatten().collect();
                let &[a, b] = ends.as_slice() else { return Err(CentrodeError::RidesAsPlaced) };
                libm::atan2(b[1] - a[1], b[0] - a[0])
            }
            Input::Slide { .. } => return Err(CentrodeError::RidesAsPlaced),
        };
        let released = release(asking, &places)?;
        let mut size: f64 = 0.0;
        for p in places.iter().flatten() {
            size = size.max(libm::hypot(p[0] - origin[0], p[1] - origin[1]));
        }
        let rig = Self {
            mechanism: released,
            structure,
            plan,
            scales,
            links,
            input: 0,
            now,
            origin,
            size,
            present: None,
        };
        rig.standing()
    }

    /// The same with the present frames of both links.
    fn standing(mut self) -> Result<Self, CentrodeError> {
        let found = position(&self.mechanism, self.structure, &self.plan, self.scales, self.links)?;
        let (places, _) = found.ok_or(CentrodeError::Permanent)?;
        let frames = self.links.map(|link| self.frame(link, &places, 0));
        let [Some(first), Some(second)] = frames else { return Err(CentrodeError::Turning) };
        self.present = Some([first, second]);
        Ok(self)
    }

    fn present(&self) -> Result<Station, CentrodeError> {
        self.at(self.now, None).ok_or(CentrodeError::Turning)
    }

    /// The mechanism with its input here and its points near these places.
    fn at(&self, input: f64, near: Option<&[Option<[f64; 2]>]>) -> Option<Station> {
        let mut moved = self.mechanism.clone();
        match &mut moved.inputs[self.input] {
            Input::Angle { angle, .. } | Input::Speed { angle, .. } => *angle = Some(Given::exact(input)),
            Input::Slide { at, .. } => *at = Some(Given::exact(input)),
        }
        for (point, near) in moved.points.iter_mut().zip(near.into_iter().flatten()) {
            if let (Some(near), Place::Near(_) | Place::Unknown) = (near, point.place) {
                point.place = Place::Near([0, 1].map(|k| near[k] + self.origin[k]));
            }
        }
        let found = position(&moved, self.structure, &self.plan, self.scales, self.links).ok()?;
        let (places, centre) = found?;
        let present = self.present?;
        let mut loci = [[0.0; 3]; 2];
        for (which, locus) in loci.iter_mut().enumerate() {
            let frame = self.frame(self.links[which], &places, 0)?;
            *locus = present[which].carried(frame.own(centre));
        }
        loci.iter().flatten().all(|x| x.is_finite()).then_some(Station { input, places, loci })
    }

    /// How a link stands: by two of its points, or as the guide in which it does not turn.
    fn frame(&self, link: LinkId, places: &[Option<[f64; 2]>], depth: usize) -> Option<Frame> {
        if link == LinkId::FRAME {
            return Some(Frame { origin: [0.0; 2], along: [1.0, 0.0] });
        }
        let own = self.mechanism.link(link);
        let known: Vec<[f64; 2]> = own.points.iter().filter_map(|p| places[p.0]).collect();
        let &origin = known.first()?;
        let away = |p: &[f64; 2]| libm::hypot(p[0] - origin[0], p[1] - origin[1]);
        // The same two points at every station: the first, and the first that lies apart from it.
        let other = known[1..].iter().find(|p| away(p) > 1e-6 * self.size.max(f64::MIN_POSITIVE));
        if let Some(other) = other {
            let length = away(other);
            return Some(Frame { origin, along: [0, 1].map(|k| (other[k] - origin[k]) / length) });
        }
        if depth > self.mechanism.links.len() {
            return None;
        }
        let guide = self.mechanism.slides.iter().find_map(|slide| {
            let rides = match slide.rider {
                Rider::Pin { block, .. } => block == Some(link),
                Rider::Link { link: rider, .. } => rider == link,
            };
            (rides && matches!(slide.guide.path, Path::Straight { .. })).then_some(slide.guide.link)
        })?;
        Some(Frame { origin, ..self.frame(guide, places, depth + 1)? })
    }

    /// Whether the input is an angle.
    fn turns(&self) -> bool {
        !matches!(self.mechanism.inputs[self.input], Input::Slide { .. })
    }

    /// A whole turn of the input, or the size of the mechanism.
    fn whole(&self) -> f64 {
        if self.turns() { std::f64::consts::TAU } else { self.size }
    }

    /// Stations from the present one in one direction of the input, to its limit or round to the beginning.
    fn run(&self, start: &Station, sense: f64) -> (Vec<Station>, bool) {
        let turns = self.turns();
        let whole = self.whole();
        let step = sense * whole / STEPS;
        let mut stations = vec![start.clone()];
        for turn in 1..=MOST_TURNS {
            let end = start.input + sense * whole * turn as f64;
            while let Some(last) = stations.last() {
                let left = end - last.input;
                if left * sense <= 0.5 * step.abs() / f64::from(1_u32 << 20) {
                    break;
                }
                let next = if left.abs() < step.abs() { end } else { last.input + step };
                match self.onward(&stations, next) {
                    Some(station) => stations.push(station),
                    None => {
                        if let Some(limit) = self.limit(&stations, next) {
                            stations.push(limit);
                        }
                        return (stations, false);
                    }
                }
            }
            let back = stations.last().is_some_and(|s| self.apart(s, start) < 1e-6 * self.size);
            if turns && back {
                return (stations, true);
            }
        }
        (stations, false)
    }

    /// The next station, by as many halved steps as it takes to keep to one assembly.
    fn onward(&self, stations: &[Station], next: f64) -> Option<Station> {
        let last = stations.last()?;
        let mut goal = next;
        for _ in 0..HALVINGS / 4 {
            let near = expected(stations, goal);
            if let Some(station) = self.at(goal, Some(&near))
                && self.apart(&station, last) < LONGEST_MOVE * self.size
            {
                return Some(station);
            }
            goal = f64::midpoint(last.input, goal);
        }
        None
    }

    /// The last station before the chain opens.
    fn limit(&self, stations: &[Station], beyond: f64) -> Option<Station> {
        let last = stations.last()?;
        let (mut inside, mut outside) = (last.input, beyond);
        let mut found: Option<Station> = None;
        for _ in 0..HALVINGS {
            let middle = f64::midpoint(inside, outside);
            let near = &found.as_ref().unwrap_or(last).places;
            match self.at(middle, Some(near)) {
                Some(station) if self.apart(&station, last) < LONGEST_MOVE * self.size => {
                    inside = middle;
                    found = Some(station);
                }
                _ => outside = middle,
            }
        }
        found
    }

    /// The longest way that a point has moved.
    fn apart(&self, a: &Station, b: &Station) -> f64 {
        let pairs = a.places.iter().zip(&b.places);
        let moved = pairs.filter_map(|(p, q)| {
            let (p, q) = ((*p)?, (*q)?);
            Some(libm::hypot(p[0] - q[0], p[1] - q[1]))
        });
        moved.fold(0.0, f64::max)
    }

    fn between(&self, a: &Station, b: &Station) -> Option<Station> {
        let near: Vec<Option<[f64; 2]>> = a
            .places
            .iter()
            .zip(&b.places)
            .map(|(p, q)| {
                let (p, q) = ((*p)?, (*q)?);
                Some([0, 1].map(|k| f64::midpoint(p[k], q[k])))
            })
            .collect();
        self.at(f64::midpoint(a.input, b.input), Some(&near))
    }

    /// The locus as connected pieces within reach.
    fn branches(&self, stations: &[Station], closed: bool, which: usize, fineness: Fineness) -> Vec<Branch> {
        let within =
            |s: &Station| finite(s.loci[which]).is_some_and(|p| libm::hypot(p[0], p[1]) <= fineness.reach);
        let mut ring: Vec<Station> = stations.to_vec();
        // What lies beyond the two ends of a closed ring: where it is within reach next.
        let mut around: [Option<Station>; 2] = [None, None];
        if closed {
            if let Some(out) = ring.iter().position(|s| !within(s)) {
                // Begin outside, so that no piece is cut where the input happens to stand; what is moved behind
                // the end comes one round later.
                let round = ring.last().map_or(0.0, |last| last.input - ring[0].input);
                ring.pop();
                let mut later: Vec<Station> = ring.drain(..out).collect();
                ring.append(&mut later);
                let count = ring.len();
                for station in &mut ring[count - out..] {
                    station.input += round;
                }
                // The stretch outside is looked at from both its sides.
                let stretch: Vec<Station> = ring.iter().take_while(|s| !within(s)).cloned().collect();
                let beyond = |s: &Station, by: f64| Station { input: s.input + by, ..s.clone() };
                around[0] = ring.iter().rev().find(|s| within(s)).map(|s| beyond(s, -round));
                around[1] = ring.iter().find(|s| within(s)).map(|s| beyond(s, round));
                ring.extend(stretch.iter().map(|s| beyond(s, round)));
            } else {
                let mut pieces = self.fine(&ring, which, fineness);
                if let [points] = pieces.as_mut_slice()
                    && let Some(first) = points.first().copied()
                    && let Some(last) = points.last_mut()
                {
                    *last = first;
                    return vec![Branch { points: std::mem::take(points), ends: [BranchEnd::Closed; 2] }];
                }
                return connected(pieces, [BranchEnd::Gap; 2]);
            }
        }
        let mut all = Vec::new();
        let mut i = 0;
        while i < ring.len() {
            if !within(&ring[i]) {
                i += 1;
                continue;
            }
            let first = i;
            while i < ring.len() && within(&ring[i]) {
                i += 1;
            }
            let mut run: Vec<Station> = ring[first..i].to_vec();
            let mut ends = [BranchEnd::Limit; 2];
            if first > 0 {
                let before: Vec<Station> = around[0].iter().chain(&ring[..first]).cloned().collect();
                let (edge, end) = self.leave(&before, &ring[first], which, fineness, true);
                run.splice(0..0, edge);
                ends[0] = end;
            }
            if i < ring.len() {
                let after: Vec<Station> = ring[i..].iter().chain(&around[1]).cloned().collect();
                let (edge, end) = self.leave(&after, &ring[i - 1], which, fineness, false);
                run.extend(edge);
                ends[1] = end;
            }
            all.append(&mut connected(self.fine(&run, which, fineness), ends));
        }
        all
    }

    /// Where a locus leaves the reach between a station within and those without, and whether it goes on to
    /// infinity.
    fn leave(
        &self,
        without: &[Station],
        inside: &Station,
        which: usize,
        fineness: Fineness,
        before: bool,
    ) -> (Option<Station>, BranchEnd) {
        let mut outward: Vec<&Station> = without.iter().collect();
        if before {
            outward.reverse();
        }
        let Some(&nearest) = outward.first() else { return (None, BranchEnd::Reach) };
        let (mut near, mut far) = (inside.clone(), nearest.clone());
        let within =
            |s: &Station| finite(s.loci[which]).is_some_and(|p| libm::hypot(p[0], p[1]) <= fineness.reach);
        for _ in 0..HALVINGS {
            let Some(middle) = self.between(&near, &far) else { break };
            if within(&middle) { near = middle } else { far = middle }
        }
        // The outside stretch, as long as it lasts, looked at from beyond: at infinity the inverse passes zero.
        // It may pass there in the last step before it is within again.
        let lasting = outward.iter().take_while(|s| !within(s)).count();
        let stretch = std::iter::once(&far).chain(outward.iter().copied().take(lasting + 1));
        let stretch: Vec<&Station> = stretch.collect();
        let crossing = stretch.windows(2).find(|pair| {
            let (u, v) = (inverse(pair[0].loci[which]), inverse(pair[1].loci[which]));
            u[0] * v[0] + u[1] * v[1] <= 0.0
        });
        let Some(&[a, b]) = crossing else { return (Some(near), BranchEnd::Reach) };
        let (mut a, mut b) = (a.clone(), b.clone());
        for _ in 0..HALVINGS {
            let Some(middle) = self.between(&a, &b) else { break };
            let (u, v) = (inverse(a.loci[which]), inverse(middle.loci[which]));
            if u[0] * v[0] + u[1] * v[1] > 0.0 { a = middle } else { b = middle }
        }
        let [x, y, _] = a.loci[which];
        let length = libm::hypot(x, y);
        let out = finite(near.loci[which]).unwrap_or_default();
        let sign = if x * out[0] + y * out[1] < 0.0 { -1.0 } else { 1.0 };
        (Some(near), BranchEnd::Infinity([sign * x / length, sign * y / length]))
    }

    /// The points of a run of stations, as many as its curvature needs, in as many pieces as it has jumps.
    fn fine(&self, run: &[Station], which: usize, fineness: Fineness) -> Vec<Vec<[f64; 2]>> {
        let mut tracing = Tracing { rig: self, which, tolerance: fineness.tolerance, pieces: Vec::new() };
        tracing.pieces.push(run.first().and_then(|s| finite(s.loci[which])).into_iter().collect());
        for pair in run.windows(2) {
            tracing.refine(&pair[0], &pair[1], REFINEMENTS);
        }
        tracing.pieces.retain(|piece| piece.len() > 1);
        tracing.pieces
    }
}

/// A locus while it is refined.
struct Tracing<'a> {
    rig: &'a Rig<'a>,
    which: usize,
    tolerance: f64,
    pieces: Vec<Vec<[f64; 2]>>,
}

impl Tracing<'_> {
    fn refine(&mut self, a: &Station, b: &Station, left: u32) {
        let (Some(p), Some(q)) = (finite(a.loci[self.which]), finite(b.loci[self.which])) else { return };
        let middle = self.rig.between(a, b);
        if let Some(middle) = middle
            && let Some(m) = finite(middle.loci[self.which])
        {
            let chord = libm::hypot(q[0] - p[0], q[1] - p[1]);
            let first = libm::hypot(m[0] - p[0], m[1] - p[1]);
            let second = libm::hypot(q[0] - m[0], q[1] - m[1]);
            // A middle that lies at one end betrays a jump: a position in which the centre is not determined.
            let even = first.min(second) > UNEVEN * chord || chord < self.tolerance;
            if left > 0 && !(even && off_chord(m, p, q) <= self.tolerance) {
                self.refine(a, &middle, left - 1);
                self.refine(&middle, b, left - 1);
                return;
            }
            if !even {
                self.pieces.push(vec![q]);
                return;
            }
        }
        match self.pieces.last_mut() {
            Some(piece) => piece.push(q),
            None => self.pieces.push(vec![q]),
        }
    }
}

/// Pieces as branches: the outer ends as they are, those between at gaps.
fn connected(pieces: Vec<Vec<[f64; 2]>>, ends: [BranchEnd; 2]) -> Vec<Branch> {
    let count = pieces.len();
    let pieces = pieces.into_iter().enumerate();
    pieces
        .map(|(i, points)| {
            let first = if i == 0 { ends[0] } else { BranchEnd::Gap };
            let last = if i + 1 == count { ends[1] } else { BranchEnd::Gap };
            Branch { points, ends: [first, last] }
        })
        .collect()
}

/// A mechanism whose placed links keep their shapes while they move.
fn release(mut mechanism: Mechanism, places: &[Option<[f64; 2]>]) -> Result<Mechanism, CentrodeError> {
    if mechanism.slides.iter().any(|s| matches!(s.rider, Rider::Link { turned: None, .. })) {
        return Err(CentrodeError::RidesAsPlaced);
    }
    for index in 1..mechanism.links.len() {
        if !matches!(mechanism.links[index].form, Form::Placed) {
            continue;
        }
        let exact = |p: &PointId| mechanism.points[p.0].place.exact();
        let shape: Option<Vec<_>> = mechanism.links[index].points.iter().map(exact).collect();
        mechanism.links[index].form = Form::Shape(shape.ok_or(CentrodeError::RidesAsPlaced)?);
    }
    for (point, place) in mechanism.points.iter_mut().zip(places) {
        if !matches!(point.place, Place::Fixed(_)) {
            point.place = place.map_or(Place::Unknown, Place::Near);
        }
    }
    Ok(mechanism)
}

/// Places by point, metres in the skeleton's frame, and the centre.
type Position = (Vec<Option<[f64; 2]>>, Homogeneous);

/// Draws one position; `None` where nothing leads to the centre.
fn position(
    mechanism: &Mechanism,
    structure: &Structure,
    plan: &Plan,
    scales: Scales,
    links: [LinkId; 2],
) -> Result<Option<Position>, DrawError> {
    let drawn = draw(Board::scratch(), mechanism, structure, plan, scales)?;
    let places = drawn.record().space.places.iter();
    let places = places.map(|p| p.map(|at| at.map(|x| x * scales.length()))).collect();
    let known = drawn.centres.known.get(&chord(links[0], links[1]));
    Ok(known.map(|centre| {
        let [x, y, w] = centre.in_paper();
        (places, [x * scales.length(), y * scales.length(), w])
    }))
}

/// Where the points will be, from how they moved last.
fn expected(stations: &[Station], input: f64) -> Vec<Option<[f64; 2]>> {
    let [.., before, last] = stations else {
        return stations.last().map_or_else(Vec::new, |s| s.places.clone());
    };
    let run = last.input - before.input;
    let part = if run == 0.0 { 0.0 } else { ((input - last.input) / run).clamp(-2.0, 2.0) };
    let pairs = last.places.iter().zip(&before.places);
    pairs
        .map(|(now, then)| {
            let now = (*now)?;
            let then = then.unwrap_or(now);
            Some([0, 1].map(|k| now[k] + (now[k] - then[k]) * part))
        })
        .collect()
}

/// The point, unless it is at infinity as far as doubles tell.
fn finite([x, y, w]: Homogeneous) -> Option<[f64; 2]> {
    let at = [x / w, y / w];
    at.iter().all(|c| c.is_finite()).then_some(at)
}

/// The point inverted in the unit circle: a smooth curve through zero where the point runs through infinity.
fn inverse([x, y, w]: Homogeneous) -> [f64; 2] {
    let square = x * x + y * y;
    if square > 0.0 { [x * w / square, y * w / square] } else { [0.0; 2] }
}

/// Distance of a point from a chord.
fn off_chord(m: [f64; 2], p: [f64; 2], q: [f64; 2]) -> f64 {
    let (d, e) = ([q[0] - p[0], q[1] - p[1]], [m[0] - p[0], m[1] - p[1]]);
    let square = d[0] * d[0] + d[1] * d[1];
    if square == 0.0 {
        return libm::hypot(e[0], e[1]);
    }
    let t = ((e[0] * d[0] + e[1] * d[1]) / square).clamp(0.0, 1.0);
    libm::hypot(e[0] - t * d[0], e[1] - t * d[1])
}
