//! The structure of a mechanism as a textbook tells it: kinds of links, pairs, mobility as a formula,
//! groups with class and order, for each four-bar loop its Grashof class, and for four-bar and slider-crank
//! loops the transmission angle and the dead positions in closed form.
//!
//! **Architecture Invariant:** the pose comes in as a function; nothing here knows who found it.

use std::f64::consts::PI;
use std::fmt;

use super::slider_crank::{SliderCrank, slider_cranks};
use super::structure::{Group, GroupKind, Joint, Mobility, Structure, StructureError};
use super::{Form, Link, LinkId, Mechanism, PointId, Rider, Roll};

/// Where a point is in the present pose, metres; `None` where nobody knows.
pub type Places<'a> = dyn Fn(PointId) -> Option<[f64; 2]> + 'a;

/// A link by the number of its joints.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LinkReport {
    /// Its number.
    pub number: u32,
    /// How many pairs touch it; a pin of several links is one joint of each.
    pub joints: usize,
    /// A block.
    pub block: bool,
}

impl LinkReport {
    /// The textbook's name for that many joints.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self.joints {
            0 => "free",
            1 => "singular",
            2 => "binary",
            3 => "ternary",
            4 => "quaternary",
            _ => "of higher order",
        }
    }
}

/// Kinds of pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum PairKind {
    /// Turning pair; a pin of k links is k − 1 of them.
    Turning,
    /// Block or link on a guide.
    Sliding,
    /// Pin in a bare slot, a higher pair.
    PinInSlot,
    /// Rolling pair or gear mesh.
    Rolling,
}

impl fmt::Display for PairKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Turning => "turning",
            Self::Sliding => "sliding",
            Self::PinInSlot => "pin in slot",
            Self::Rolling => "rolling",
        })
    }
}

/// One joint of the chain.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct PairReport {
    /// Its kind.
    pub kind: PairKind,
    /// Name of its pin, where it has one.
    pub pin: Option<String>,
    /// Numbers of the links that it joins, ascending.
    pub links: Vec<u32>,
    /// How many pairs it counts for.
    pub count: usize,
}

/// A driver or Assur group.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct GroupReport {
    /// By which construction it is solved.
    pub kind: String,
    /// Numbers of its links.
    pub links: Vec<u32>,
    /// Assur's class: 1 for a driver, 2 for a dyad, above that the largest closed contour.
    pub class: usize,
    /// Its order: the number of pairs by which it depends on what is solved.
    pub order: usize,
    /// Indices of the groups that are solved before it.
    pub after: Vec<usize>,
}

/// Class of a four-bar by Grashof's rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Grashof {
    /// s + l < p + q and the driven crank is shortest.
    CrankRocker,
    /// s + l < p + q and the output is shortest: driven from the rocker.
    RockerCrank,
    /// s + l < p + q and the frame is shortest: drag link.
    DoubleCrank,
    /// s + l < p + q and the coupler is shortest: both rock.
    DoubleRocker,
    /// s + l = p + q: the links can all lie in line, and the direction may change there.
    ChangePoint,
    /// s + l > p + q: every link rocks.
    TripleRocker,
}

impl fmt::Display for Grashof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::CrankRocker => "crank-rocker",
            Self::RockerCrank => "crank-rocker driven from the rocker",
            Self::DoubleCrank => "double crank (drag link)",
            Self::DoubleRocker => "double rocker, coupler shortest",
            Self::ChangePoint => "change-point linkage",
            Self::TripleRocker => "double rocker beyond Grashof",
        })
    }
}

/// Which links are in line.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InLine {
    /// Coupler and output: the driver can go no further, or cannot start the output.
    CouplerAndOutput,
    /// Driver and coupler: the output is at a limit of its swing, and cannot drive back.
    DriverAndCoupler,
    /// The rod stands square to the guide: the crank can go no further.
    CouplerSquareToGuide,
}

/// A position of the driver at which two links are in line.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DeadPosition {
    /// Which links.
    pub links: InLine,
    /// Stretched out, or folded over each other.
    pub extended: bool,
    /// Angle of the driver from +x, radians in [0, 2π).
    pub angle: f64,
    /// How far the driver has to turn from here, radians in (−π, π], ccw positive.
    pub turn: f64,
    /// Angle of the triangle at the driver's pivot: positive where it lies left of the frame.
    pub side: f64,
}

/// A four-bar loop: driver, coupler and output between two fixed pivots.
#[derive(Debug, Clone, PartialEq)]
pub struct FourBar {
    /// Numbers of driver, coupler and output.
    pub links: [u32; 3],
    /// Names of the driver's pivot, the two moving pins and the output's pivot.
    pub joints: [String; 4],
    /// Frame, driver, coupler, output, metres.
    pub lengths: [f64; 4],
    /// Its class.
    pub class: Grashof,
    /// Angle between coupler and output at this position, radians in [0, π].
    pub transmission: Option<f64>,
    /// Its least and greatest values over a turn, where the driver can turn fully.
    pub transmission_range: Option<[f64; 2]>,
    /// Dead positions, the nearest first.
    pub dead: Vec<DeadPosition>,
}

impl FourBar {
    /// Pressure angle at the output's pin: between the coupler's push and the pin's velocity, in [0, π/2].
    #[must_use]
    pub fn pressure(&self) -> Option<f64> {
        self.transmission.map(|t| (PI / 2.0 - t).abs())
    }
}

/// The whole report.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Every link, the frame first.
    pub links: Vec<LinkReport>,
    /// Every joint.
    pub pairs: Vec<PairReport>,
    /// The count.
    pub mobility: Mobility,
    /// Numbers of links whose turning about their only pin moves nothing else: F_d of the count.
    pub idle: Vec<u32>,
    /// Redundant constraints if the linkage stood in space with the same pairs,
    /// b = M − 6(n − j − 1) − Σf.
    pub redundant_in_space: i64,
    /// Groups in order of transmission; empty where the mechanism cannot be taken apart.
    pub groups: Vec<GroupReport>,
    /// Why it cannot be taken apart.
    pub refused: Option<String>,
    /// Its four-bar loops.
    pub four_bars: Vec<FourBar>,
    /// Its slider-crank loops.
    pub slider_cranks: Vec<SliderCrank>,
}

/// Reports on a mechanism; `places` is its pose as far as it is known.
#[must_use]
pub fn report(mechanism: &Mechanism, places: &Places<'_>) -> Report {
    let (mobility, structure, refused) = match Structure::of(mechanism) {
        Ok(structure) => (structure.mobility.clone(), Some(structure), None),
        Err(error) => {
            let said = error.to_string();
            let (StructureError::UnderConstrained { mobility, .. }
            | StructureError::OverConstrained { mobility, .. }) = error;
            (mobility, None, Some(said))
        }
    };
    let groups = structure.iter().flat_map(|s| &s.groups).map(|g| group(mechanism, g)).collect();
    let four_bars =
        structure.iter().flat_map(|s| &s.groups).flat_map(|g| four_bars(mechanism, g, places)).collect();
    let slider_cranks = structure.iter().flat_map(|s| slider_cranks(mechanism, s, places)).collect();
    let links: Vec<LinkReport> = (0..mechanism.links.len()).map(|l| link(mechanism, LinkId(l))).collect();
    Report {
        idle: idle(mechanism, &links),
        redundant_in_space: redundant_in_space(&mobility),
        links,
        pairs: pairs(mechanism),
        mobility,
        groups,
        refused,
        four_bars,
        slider_cranks,
    }
}

fn stands(mechanism: &Mechanism, link: LinkId, point: PointId) -> bool {
    mechanism.link(link).points.contains(&point)
}

fn roll_links(roll: &Roll) -> [LinkId; 2] {
    match roll {
        Roll::Circles { links, .. } => *links,
        Roll::Line { guide, wheel, .. } => [guide.link, *wheel],
    }
}

fn link(mechanism: &Mechanism, id: LinkId) -> LinkReport {
    let Link { number, block, points, .. } = mechanism.link(id);
    let pins = points.iter().filter(|p| mechanism.point(**p).links.len() > 1).count();
    let slides = mechanism
        .slides
        .iter()
        .filter(|slide| {
            let rides = match slide.rider {
                Rider::Pin { block: Some(block), .. } => block == id,
                // A bare pin of several links is their joint already.
                Rider::Pin { point, block: None } => {
                    stands(mechanism, id, point) && mechanism.point(point).links.len() == 1
                }
                Rider::Link { link, .. } => link == id,
            };
            rides || slide.guide.link == id
        })
        .count();
    let rolls = mechanism.rolls.iter().filter(|roll| roll_links(roll).contains(&id)).count();
    LinkReport { number: *number, joints: pins + slides + rolls, block: *block }
}

fn pairs(mechanism: &Mechanism) -> Vec<PairReport> {
    let number = |link: LinkId| mechanism.link(link).number;
    let sorted = |links: &mut Vec<u32>| links.sort_unstable();
    let mut pairs = Vec::new();
    for point in &mechanism.points {
        if point.links.len() > 1 {
            pairs.push(PairReport {
                kind: PairKind::Turning,
                pin: Some(point.name.clone()),
                links: point.links.iter().map(|l| number(*l)).collect(),
                count: point.links.len() - 1,
            });
        }
    }
    for slide in &mechanism.slides {
        let (kind, pin, riders) = match slide.rider {
            Rider::Pin { point, block: Some(block) } => (PairKind::Sliding, Some(point), vec![block]),
            Rider::Pin { point, block: None } => {
                (PairKind::PinInSlot, Some(point), mechanism.point(point).links.clone())
            }
            Rider::Link { link, .. } => (PairKind::Sliding, None, vec![link]),
        };
        let mut links: Vec<u32> = riders.into_iter().chain([slide.guide.link]).map(number).collect();
        sorted(&mut links);
        let pin = pin.map(|p| mechanism.point(p).name.clone());
        pairs.push(PairReport { kind, pin, links, count: 1 });
    }
    for roll in &mechanism.rolls {
        let mut links: Vec<u32> = roll_links(roll).into_iter().map(number).collect();
        sorted(&mut links);
        pairs.push(PairReport { kind: PairKind::Rolling, pin: None, links, count: 1 });
    }
    pairs
}

/// A link that only depends on one pin turns there without moving anything.
fn idle(mechanism: &Mechanism, links: &[LinkReport]) -> Vec<u32> {
    links
        .iter()
        .zip(&mechanism.links)
        .skip(1)
        .filter(|(report, link)| {
            report.joints == 1 && link.points.iter().any(|p| mechanism.point(*p).links.len() > 1)
        })
        .filter(|(report, _)| !driven(mechanism, report.number))
        .map(|(report, _)| report.number)
        .collect()
}

fn driven(mechanism: &Mechanism, number: u32) -> bool {
    mechanism.inputs.iter().any(|input| match input {
        super::Input::Angle { link, .. } | super::Input::Speed { link, .. } => {
            mechanism.link(*link).number == number
        }
        super::Input::Slide { .. } => false,
    })
}

fn redundant_in_space(mobility: &Mobility) -> i64 {
    let signed = |count: usize| i64::try_from(count).unwrap_or(i64::MAX);
    let lower = signed(mobility.turning + mobility.sliding + mobility.rolling);
    let higher = signed(mobility.higher);
    mobility.freedoms - 6 * (signed(mobility.links) - (lower + higher) - 1) - (lower + 2 * higher)
}

fn group(mechanism: &Mechanism, group: &Group) -> GroupReport {
    let links = group.links.iter().map(|l| mechanism.link(*l).number).collect();
    let (class, order) = match group.kind {
        GroupKind::Driver { .. }
        | GroupKind::DrivenSlide { .. }
        | GroupKind::DrivenWheel { .. }
        | GroupKind::DrivenRack { .. } => (1, 1),
        GroupKind::DrivenBar { holds, .. } if holds.iter().any(|hold| hold.rod().is_some()) => {
            contour(mechanism, group)
        }
        GroupKind::DrivenBar { .. } => (1, 2),
        GroupKind::Driven { .. } => contour(mechanism, group),
        GroupKind::Higher { .. } | GroupKind::Other => contour(mechanism, group),
        GroupKind::Rrr { .. }
        | GroupKind::Rrp { .. }
        | GroupKind::Rpr { .. }
        | GroupKind::Prp { .. }
        | GroupKind::Rpp { .. }
        | GroupKind::Yoke { .. }
        | GroupKind::Wheel { .. }
        | GroupKind::Rack { .. }
        | GroupKind::Rolling { .. }
        | GroupKind::Planet { .. }
        | GroupKind::RidingCentre { .. }
        | GroupKind::HeldCentre { .. }
        | GroupKind::PinnedRack { .. } => (2, 2),
    };
    GroupReport { kind: group.kind.to_string(), links, class, order, after: group.after.clone() }
}

/// Class and order by Artobolevsky: the class is the number of sides of the largest closed contour of
/// inner pairs, where a link with k inner and outer pairs is a contour of k sides; the order is the number
/// of outer pairs. A block or a bare slot is one side of its guide's link.
fn contour(mechanism: &Mechanism, group: &Group) -> (usize, usize) {
    let inside = |link: &LinkId| group.links.contains(link);
    let mut inner: Vec<[LinkId; 2]> = Vec::new();
    let mut outer = 0;
    let mut sides = vec![0; mechanism.links.len()];
    let mut join = |a: LinkId, b: LinkId| match (inside(&a), inside(&b)) {
        (true, true) => {
            inner.push([a, b]);
            sides[a.0] += 1;
            sides[b.0] += 1;
        }
        (true, false) | (false, true) => {
            outer += 1;
            sides[if inside(&a) { a.0 } else { b.0 }] += 1;
        }
        (false, false) => {}
    };
    for point in &mechanism.points {
        // A pin of several links joins the first with each other one.
        if let [first, rest @ ..] = point.links.as_slice() {
            rest.iter().for_each(|other| join(*first, *other));
        }
    }
    for joint in &group.joints {
        if let Joint::Slide(index) = joint {
            let slide = mechanism.slides[*index];
            let rider = match slide.rider {
                Rider::Pin { block: Some(link), .. } | Rider::Link { link, .. } => Some(link),
                Rider::Pin { point, block: None } => mechanism.point(point).links.first().copied(),
            };
            if let Some(rider) = rider {
                join(rider, slide.guide.link);
            }
        }
    }
    let cycle = shortest_cycles(&inner).into_iter().max().unwrap_or(0);
    let polygon =
        group.links.iter().filter(|l| !mechanism.link(**l).block).map(|l| sides[l.0]).max().unwrap_or(0);
    (cycle.max(polygon).max(2), outer)
}

/// For each inner pair, the number of links in the shortest closed contour through it.
fn shortest_cycles(pairs: &[[LinkId; 2]]) -> Vec<usize> {
    let mut cycles = Vec::new();
    for (skip, [start, goal]) in pairs.iter().enumerate() {
        let mut reached = vec![*start];
        let mut length = 1;
        loop {
            if reached.contains(goal) {
                cycles.push(length);
                break;
            }
            let next: Vec<LinkId> = pairs
                .iter()
                .enumerate()
                .filter(|(index, _)| *index != skip)
                .flat_map(|(_, [a, b])| [(*a, *b), (*b, *a)])
                .filter(|(from, to)| reached.contains(from) && !reached.contains(to))
                .map(|(_, to)| to)
                .collect();
            if next.is_empty() {
                break;
            }
            reached.extend(next);
            length += 1;
        }
    }
    cycles
}

/// Distance of two points of a link: as it was given, else off the pose.
pub(super) fn span(
    mechanism: &Mechanism,
    link: LinkId,
    a: PointId,
    b: PointId,
    places: &Places<'_>,
) -> Option<f64> {
    let Link { form, points, .. } = mechanism.link(link);
    let index = |p: PointId| points.iter().position(|q| *q == p);
    match (form, index(a), index(b)) {
        (Form::Length(length), Some(i), Some(j)) if i + j == 1 => return Some(length.value),
        (Form::Line(at), Some(i), Some(j)) => return Some((at[i].value - at[j].value).abs()),
        (Form::Sides { first_second, second_third, third_first, .. }, Some(i), Some(j)) => {
            return match i + j {
                1 => Some(first_second.value),
                2 => Some(third_first.value),
                _ => Some(second_third.value),
            };
        }
        _ => {}
    }
    let exact = |p: PointId| mechanism.point(p).place.exact().map(|at| at.map(|x| x.value));
    let [a, b] = match (exact(a), exact(b)) {
        (Some(a), Some(b)) => [a, b],
        _ => [places(a)?, places(b)?],
    };
    Some(libm::hypot(b[0] - a[0], b[1] - a[1]))
}

/// The fixed pivot of a link.
pub(super) fn pivot(mechanism: &Mechanism, link: LinkId) -> Option<PointId> {
    mechanism.link(link).points.iter().copied().find(|p| mechanism.is_fixed(*p))
}

fn four_bars(mechanism: &Mechanism, group: &Group, places: &Places<'_>) -> Vec<FourBar> {
    let GroupKind::Rrr { links, bases, pin } = group.kind else { return Vec::new() };
    [(0, 1), (1, 0)]
        .into_iter()
        .filter(|&(_, out)| mechanism.is_fixed(bases[out]))
        .filter_map(|(coupler, out)| {
            let start = bases[coupler];
            let driver = mechanism
                .point(start)
                .links
                .iter()
                .copied()
                .find(|&l| !links.contains(&l) && l != LinkId::FRAME && pivot(mechanism, l).is_some())?;
            let from = pivot(mechanism, driver)?;
            four_bar(mechanism, [driver, links[coupler], links[out]], [from, start, pin, bases[out]], places)
        })
        .collect()
}

/// Two sums of four lengths are equal where they differ by less than this part of them: lengths of ten
/// significant digits that were stated as equal sums.
const SAME_SUM: f64 = 1e-10;

/// Class of a four-bar with frame, driver, coupler and output of these lengths.
#[must_use]
pub fn grashof(lengths: [f64; 4]) -> Grashof {
    let mut sorted = lengths;
    sorted.sort_by(f64::total_cmp);
    let [s, p, q, l] = sorted;
    let difference = (s + l) - (p + q);
    if difference.abs() <= SAME_SUM * (s + l + p + q) {
        return Grashof::ChangePoint;
    }
    if difference > 0.0 {
        return Grashof::TripleRocker;
    }
    match lengths.iter().position(|x| *x == s) {
        Some(0) => Grashof::DoubleCrank,
        Some(1) => Grashof::CrankRocker,
        Some(2) => Grashof::DoubleRocker,
        _ => Grashof::RockerCrank,
    }
}

fn four_bar(
    mechanism: &Mechanism,
    links: [LinkId; 3],
    joints: [PointId; 4],
    places: &Places<'_>,
) -> Option<FourBar> {
    let [from, start, pin, to] = joints;
    let fixed = |p: PointId| mechanism.point(p).place.exact().map(|at| at.map(|x| x.value));
    let (base, end) = (fixed(from)?, fixed(to)?);
    let frame = [end[0] - base[0], end[1] - base[1]];
    let lengths = [
        libm::hypot(frame[0], frame[1]),
        span(mechanism, links[0], from, start, places)?,
        span(mechanism, links[1], start, pin, places)?,
        span(mechanism, links[2], pin, to, places)?,
    ];
    let class = grashof(lengths);
    let at = |p: PointId| places(p);
    let between = |corner: PointId, a: PointId, b: PointId| {
        let (corner, a, b) = (at(corner)?, at(a)?, at(b)?);
        let (u, v) = ([a[0] - corner[0], a[1] - corner[1]], [b[0] - corner[0], b[1] - corner[1]]);
        Some(libm::atan2((u[0] * v[1] - u[1] * v[0]).abs(), u[0] * v[0] + u[1] * v[1]))
    };
    let now = match (at(from), at(start)) {
        (Some(a), Some(b)) => Some(libm::atan2(b[1] - a[1], b[0] - a[0])),
        _ => None,
    };
    // A rocker with a crank stays on its side of the frame, so only that assembly's positions are near.
    let side_of =
        |p: PointId| at(p).zip(at(from)).map(|(p, o)| frame[0] * (p[1] - o[1]) - frame[1] * (p[0] - o[0]));
    let side = match class {
        Grashof::CrankRocker => side_of(pin),
        Grashof::RockerCrank => side_of(start),
        _ => None,
    };
    let mut dead = dead_positions(lengths, libm::atan2(frame[1], frame[0]), now);
    dead.retain(|d| side.is_none_or(|s| s * d.side >= 0.0));
    dead.sort_by(|a, b| a.turn.abs().total_cmp(&b.turn.abs()));
    let turns_fully = matches!(class, Grashof::CrankRocker | Grashof::DoubleCrank | Grashof::ChangePoint);
    Some(FourBar {
        links: links.map(|l| mechanism.link(l).number),
        joints: joints.map(|p| mechanism.point(p).name.clone()),
        lengths,
        class,
        transmission: between(pin, start, to),
        transmission_range: turns_fully.then(|| transmission_range(lengths)).flatten(),
        dead,
    })
}

/// The angle opposite the third side of a triangle, where there is one.
fn opposite(a: f64, b: f64, c: f64) -> Option<f64> {
    let cosine = (a * a + b * b - c * c) / (2.0 * a * b);
    (cosine.abs() <= 1.0).then(|| libm::acos(cosine))
}

/// Least and greatest transmission angle: with the driver along the frame, either way.
fn transmission_range([frame, driver, coupler, output]: [f64; 4]) -> Option<[f64; 2]> {
    let least = opposite(coupler, output, (frame - driver).abs())?;
    let greatest = opposite(coupler, output, frame + driver)?;
    Some([least, greatest])
}

/// How far a link has to turn from its present angle to another, in (−π, π].
pub(super) fn turn_from(now: Option<f64>, angle: f64) -> f64 {
    let turn = (angle - now.unwrap_or(angle)).rem_euclid(2.0 * PI);
    if turn > PI { turn - 2.0 * PI } else { turn }
}

/// Driver angles at which two links are in line, by the triangles that they make.
fn dead_positions(
    [frame, driver, coupler, output]: [f64; 4],
    frame_angle: f64,
    now: Option<f64>,
) -> Vec<DeadPosition> {
    let mut dead: Vec<DeadPosition> = Vec::new();
    let mut add = |links: InLine, extended: bool, from_frame: f64, away: f64| {
        // Both assemblies: the triangle and its mirror image.
        for side in [from_frame, -from_frame] {
            let angle = (frame_angle + side + away).rem_euclid(2.0 * PI);
            let one = DeadPosition { links, extended, angle, turn: turn_from(now, angle), side };
            if !dead.iter().any(|d| d.links == links && d.extended == extended && d.angle == angle) {
                dead.push(one);
            }
        }
    };
    for (extended, diagonal) in [(true, coupler + output), (false, (coupler - output).abs())] {
        if let Some(angle) = opposite(frame, driver, diagonal) {
            add(InLine::CouplerAndOutput, extended, angle, 0.0);
        }
    }
    for (extended, reach) in [(true, driver + coupler), (false, (driver - coupler).abs())] {
        if let Some(angle) = opposite(frame, reach, output) {
            // Folded over a longer coupler, the driver points away from the pin.
            let away = if !extended && coupler > driver { PI } else { 0.0 };
            add(InLine::DriverAndCoupler, extended, angle, away);
        }
    }
    dead
}

#[cfg(test)]
mod tests {
    use super::{FourBar, Grashof, InLine, Report, grashof, report};
    use crate::scene;

    fn report_of(text: &str) -> Report {
        let scene = scene::read(text, "test").unwrap_or_else(|error| panic!("{error}"));
        let places = |p: crate::mechanism::PointId| scene.mechanism.point(p).place.hint();
        report(&scene.mechanism, &places)
    }

    fn example(path: &str) -> Report {
        let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        report_of(&std::fs::read_to_string(root.join(path)).unwrap())
    }

    #[test]
    fn three_links_in_a_triangle_cannot_move() {
        let r = report_of(
            r#"{ "fixed": { "O": [0, 0], "Q": [4, 0] }, "near": { "A": [0, 3] },
                "links": { "2": { "joins": ["O", "A"], "length": 3 }, "3": { "joins": ["A", "Q"], "length": 5 } },
                "input": { "link": 2, "angle": 90, "omega": 1 } }"#,
        );
        assert_eq!((r.mobility.links, r.mobility.turning, r.mobility.freedoms), (3, 3, 0));
        assert!(r.refused.is_some());
    }

    #[test]
    fn five_links_with_a_slider_have_two_freedoms() {
        let r = report_of(
            r#"{ "fixed": { "O": [0, 0] },
                "links": { "2": { "joins": ["O", "A"], "length": 1 }, "3": { "joins": ["A", "B"], "length": 2 },
                    "4": { "joins": ["B", "C"], "length": 2 } },
                "slides": [{ "pin": "C", "block": 5, "on": { "link": 1, "through": "O", "angle": 0 } }],
                "input": { "link": 2, "angle": 90, "omega": 1 } }"#,
        );
        assert_eq!((r.mobility.links, r.mobility.turning, r.mobility.sliding), (5, 4, 1));
        assert_eq!(r.mobility.freedoms, 2);
    }

    #[test]
    fn peaucellier_has_eight_links_and_ten_pairs() {
        let r = example("src/catalogue/peaucellier.json");
        assert_eq!((r.mobility.links, r.mobility.turning, r.mobility.freedoms), (8, 10, 1));
        let mut doubled: Vec<&str> =
            r.pairs.iter().filter(|p| p.count == 2).filter_map(|p| p.pin.as_deref()).collect();
        doubled.sort_unstable();
        assert_eq!(doubled, ["C", "D", "E", "O4"]);
        assert!(r.groups[1..].iter().all(|g| (g.class, g.order) == (2, 2)));
    }

    #[test]
    fn a_pantograph_without_a_guide_has_two_freedoms() {
        // A is a double joint of links 1, 2 and 5; B, C and E are simple (s000-ch1-2-5).
        let r = report_of(
            r#"{ "fixed": { "A": [0, 0] },
                "links": { "2": { "joins": ["A", "B"], "length": 2 }, "3": { "joins": ["B", "C", "D"], "line": [0, 1, 2] },
                    "4": { "joins": ["C", "E"], "length": 2 }, "5": { "joins": ["E", "A"], "length": 1 } },
                "input": { "link": 2, "angle": 60, "omega": 1 } }"#,
        );
        assert_eq!((r.mobility.links, r.mobility.turning, r.mobility.freedoms), (5, 5, 2));
        assert!(r.refused.is_some_and(|why| why.contains("1 degree of freedom left over")));
    }

    #[test]
    fn a_four_bar_in_space_has_three_redundant_constraints() {
        // s003-7
        let r = example("src/catalogue/four-bar.json");
        assert_eq!((r.mobility.freedoms, r.redundant_in_space), (1, 3));
    }

    #[test]
    fn classes_over_the_frame_lengths_of_m2_1() {
        // Links of 100, 200, 300 mm: Grashof for frames of 200 to 400, change points at both ends.
        for (frame, class) in [
            (150.0, Grashof::TripleRocker),
            (200.0, Grashof::ChangePoint),
            (250.0, Grashof::CrankRocker),
            (399.0, Grashof::CrankRocker),
            (400.0, Grashof::ChangePoint),
            (500.0, Grashof::TripleRocker),
        ] {
            assert_eq!(grashof([frame, 100.0, 200.0, 300.0]), class, "{frame}");
        }
        // Seed 004, example 3: double crank for frames below 40 mm.
        assert_eq!(grashof([39.0, 50.0, 100.0, 90.0]), Grashof::DoubleCrank);
        assert_eq!(grashof([40.0, 50.0, 100.0, 90.0]), Grashof::ChangePoint);
        assert_eq!(grashof([41.0, 50.0, 100.0, 90.0]), Grashof::TripleRocker);
    }

    fn m2_3() -> FourBar {
        let r = report_of(
            r#"{ "units": { "length": "mm" }, "fixed": { "O2": [0, 0], "O4": [100, 0] },
                "placed": { "A": [25, 0], "B": [79, 72] },
                "links": { "2": { "joins": ["O2", "A"], "length": 25 }, "3": { "joins": ["A", "B"], "length": 90 },
                    "4": { "joins": ["O4", "B"], "length": 75 } },
                "input": { "link": 2, "angle": 0, "omega": 1 } }"#,
        );
        assert_eq!(r.four_bars.len(), 1);
        r.four_bars[0].clone()
    }

    #[test]
    fn transmission_angles_of_m2_3() {
        let four_bar = m2_3();
        assert_eq!(four_bar.class, Grashof::CrankRocker);
        let [least, greatest] = four_bar.transmission_range.unwrap().map(f64::to_degrees);
        assert!((least - 53.1301).abs() < 5e-5 && (greatest - 98.0907).abs() < 5e-5);
        assert!((four_bar.transmission.unwrap().to_degrees() - 53.1301).abs() < 5e-5);
        assert!((four_bar.pressure().unwrap().to_degrees() - 36.8699).abs() < 5e-5);
    }

    #[test]
    fn limit_positions_of_m2_3() {
        let four_bar = m2_3();
        assert!(four_bar.dead.iter().all(|d| d.links == InLine::DriverAndCoupler));
        for (extended, angle) in [(true, 40.0737), (false, 228.5827)] {
            let found = four_bar
                .dead
                .iter()
                .any(|d| d.extended == extended && (d.angle.to_degrees() - angle).abs() < 5e-5);
            assert!(found, "{angle}: {:?}", four_bar.dead);
        }
        assert_eq!(four_bar.dead.len(), 2);
    }

    #[test]
    fn a_rocker_that_drives_has_dead_centres() {
        let r = example("src/catalogue/four-bar-triple-rocker.json");
        let four_bar = &r.four_bars[0];
        assert_eq!(four_bar.class, Grashof::TripleRocker);
        // Coupler and rocker in line: cos θ = (60² + 130² − 150²) / (2·60·130).
        let angle = libm::acos((3600.0 + 16900.0 - 22500.0) / 15600.0);
        let found = four_bar
            .dead
            .iter()
            .any(|d| d.links == InLine::CouplerAndOutput && d.extended && (d.angle - angle).abs() < 1e-12);
        assert!(found, "{:?}", four_bar.dead);
    }

    #[test]
    fn a_scotch_yoke_counts_its_blocks() {
        let r = example("src/catalogue/scotch-yoke.json");
        assert_eq!(
            (r.mobility.links, r.mobility.turning, r.mobility.sliding, r.mobility.freedoms),
            (4, 2, 2, 1)
        );
        assert!(r.links.iter().all(|l| l.kind() == "binary"), "{:?}", r.links);
    }

    #[test]
    fn a_bare_pin_is_a_higher_pair() {
        let r = example("src/catalogue/geneva.json");
        assert_eq!(
            (r.mobility.links, r.mobility.turning, r.mobility.higher, r.mobility.freedoms),
            (3, 2, 1, 1)
        );
    }

    #[test]
    fn an_idle_link_is_named() {
        let r = report_of(
            r#"{ "fixed": { "O": [0, 0] },
                "links": { "2": { "joins": ["O", "A"], "length": 1 }, "3": { "joins": ["A", "B"], "length": 2 } },
                "input": { "link": 2, "angle": 90, "omega": 1 } }"#,
        );
        assert_eq!(r.idle, [3]);
    }

    #[test]
    fn a_triad_is_of_the_third_class() {
        // A ternary link on three rods, each to a fixed pivot but one, which the crank drives.
        let r = report_of(
            r#"{ "fixed": { "O2": [0, 0], "P": [4, 0], "Q": [2, 4] },
                "near": { "A": [0, 1], "B": [1, 2], "C": [3, 1], "D": [2, 3] },
                "links": { "2": { "joins": ["O2", "A"], "length": 1 }, "3": { "joins": ["A", "B"], "length": 1.4 },
                    "4": { "joins": ["B", "C", "D"], "sides": [2.2, 2.2, 1.4], "turn": "ccw" },
                    "5": { "joins": ["C", "P"], "length": 1.4 }, "6": { "joins": ["D", "Q"], "length": 1 } },
                "input": { "link": 2, "angle": 90, "omega": 1 } }"#,
        );
        let triad = &r.groups[1];
        assert_eq!((triad.links.as_slice(), triad.class, triad.order), ([3, 4, 5, 6].as_slice(), 3, 3));
    }
}
