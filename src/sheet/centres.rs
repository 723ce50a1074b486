//! The skeleton with its instant centres: lines of centres, names in parentheses, arrows to what lies at infinity or
//! off the sheet.

use kurbo::{Point, Rect, Vec2};

use super::circle::{centre_name, name};
use super::compose;
use super::detail::{self, Spot};
use super::figure::{Group, Mark, Moment, Pen, Shape, Tone};
use super::growth::Births;
use super::human;
use super::ink::{FINE, HEAD, SMALL, THIN, dot, head, page};
use super::labels::{Request, Site};
use super::notation::Notation;
use super::overlap::{clip, overlaps_in};
use super::reach::{Reach, Window};
use super::rich::Rich;
use super::skeleton::{self, Arrows, Overlay, PIN};
use super::transfer;
use crate::graphical::construction::{Centre, CentreLine, CentrePlace, CircleDiagram, Construction, Found};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, Mechanism, Rider};
use crate::plan::chord;

/// The figure grows to this size at most to take a centre in; what lies further out is off the sheet.
const LARGEST: (f64, f64) = (150.0, 138.0);
/// What names, caption and running title need around a figure that fills the paper, width and height: a name stands beside a
/// centre, half of it beyond the border.
pub(super) const AROUND: (f64, f64) = (16.0, 36.0);
/// And a caption with the running title.
pub(super) const CAPTION: f64 = 20.0;
/// Blank kept between a centre that is needed and the border: its name stands above or below it.
const ABOUT_NEEDED: f64 = 5.0;
/// Blank kept between another centre and the border, and about the skeleton.
const BORDER: f64 = 9.0;
/// Centres closer than this on paper have one label.
const COINCIDENT: f64 = 0.3;

/// The skeleton with the lines of centres and the centres' names. In a crowd that leaves no room for all names, pins
/// have none: their centres are seen.
#[must_use]
pub(super) fn draw(
    circle: &CircleDiagram,
    reach: &Reach<'_>,
    notation: &Notation<'_>,
    births: Option<&Births<'_>>,
) -> Group {
    let full = drawn(circle, reach, notation, Pins::Named, births);
    if overlaps_in(&full, None).is_empty() {
        return full;
    }
    drawn(circle, reach, notation, Pins::Bare, births)
}

/// When a centre is found, told as the acts of a step after the last: the primary ones at once, each other by itself.
fn moment(circle: &CircleDiagram, links: [LinkId; 2], births: &Births<'_>) -> Moment {
    let constructed = circle.centres.iter().filter(|centre| !centre.found.is_primary());
    let own = constructed.enumerate().find(|(_, centre)| centre.links == links);
    Moment { step: births.last().step + 1, act: own.map_or(0, |(index, _)| index + 1) }
}

/// Whether the centres of pins are named.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Pins {
    Named,
    Bare,
}

fn drawn(
    circle: &CircleDiagram,
    reach: &Reach<'_>,
    notation: &Notation<'_>,
    pins: Pins,
    births: Option<&Births<'_>>,
) -> Group {
    let construction = &*reach.construction;
    let crowds = crowds(circle, reach.window);
    // Centres that stand too near to each other are named in a detail; the pictures of the steps have none.
    let places: Vec<(usize, Point)> = crowds.iter().enumerate().map(|(i, (at, _))| (i, *at)).collect();
    let spots = if births.is_none() { detail::crowded(&places) } else { Vec::new() };
    let mut group = skeleton::draw_under(construction, notation, Arrows::Inputs, births, |_, places| {
        let mut chart = Chart {
            births,
            circle,
            notation: *notation,
            places,
            pins,
            crowds: &crowds,
            spots: &spots,
            window: reach.window,
            metres_per_mm: construction.space.metres_per_mm,
            overlay: Overlay { ink: Group::new("centres"), ..Overlay::default() },
        };
        chart.lines();
        chart.points();
        chart.overlay.within = Some(reach.paper(notation));
        chart.overlay
    });
    group.class = "instant-centres".to_owned();
    detail::add_of_ink(&mut group, &spots, notation, |crowd, at| {
        let (_, crowd) = &crowds[crowd];
        let site = Site::Around { at, radius: 1.5, toward: None };
        let mut request = named(crowd, site, notation);
        request.leader = true;
        request
    });
    group
}

/// The centres within the window, those of one place together.
fn crowds(circle: &CircleDiagram, window: Rect) -> Vec<(Point, Vec<&Centre>)> {
    let mut crowds: Vec<(Point, Vec<&Centre>)> = Vec::new();
    for centre in &circle.centres {
        let Some(at) = on_paper(centre).filter(|at| window.contains(*at)) else { continue };
        match crowds.iter_mut().find(|(p, _)| p.distance(at) < COINCIDENT) {
            Some((_, crowd)) => crowd.push(centre),
            None => crowds.push((at, vec![centre])),
        }
    }
    crowds
}

/// The name of the centres of one place.
fn named(crowd: &[&Centre], site: Site, notation: &Notation<'_>) -> Request {
    let texts: Vec<Rich> = crowd.iter().map(|c| name(c.links, notation)).collect();
    let text = Rich::join(&texts, &Rich::upright(","));
    let names = crowd.iter().map(|c| centre_name(c.links, notation));
    Request::new(text, SMALL, site, "label centre-name").naming(names)
}

/// The skeleton's ink with as many centres as find room.
pub(super) fn window(
    circle: &CircleDiagram,
    construction: &Construction,
    skeleton: Rect,
    notation: &Notation<'_>,
) -> Window {
    let used = transfer::used(transfer::acts(circle, construction));
    let place = |centre: &Centre| {
        let at = on_paper(centre)?;
        Some((at, is_needed(centre, at, skeleton, &used, notation.mechanism())))
    };
    let places: Vec<(Point, bool)> = circle.centres.iter().filter_map(place).collect();
    window_over(skeleton, &places, compose::free_paper(notation.scene))
}

/// Whether the paper is chosen for a centre, which lies so beside a skeleton: a velocity is carried over by it, or the scene
/// asks for it and it is not so far off that nobody could read the skeleton any more.
pub(super) fn is_needed(
    centre: &Centre,
    at: Point,
    skeleton: Rect,
    used: &[[LinkId; 2]],
    mechanism: &Mechanism,
) -> bool {
    /// So many times the skeleton's size away.
    const FAR: f64 = 3.0;
    let [i, j] = centre.links;
    let wanted = [Quantity::Centre(i, j), Quantity::Centre(j, i)];
    let far = at.distance(skeleton.center()) > FAR * skeleton.width().max(skeleton.height());
    let asked = || mechanism.asked.iter().any(|asked| wanted.contains(&asked.quantity));
    (!far && asked()) || used.contains(&centre.links)
}

/// What a figure shows of the plane: the skeleton's ink with as many centres as find room, the nearest first; those that
/// are needed as far as the paper reaches, then the others on the part of it that a figure usually has.
pub(super) fn window_over(skeleton: Rect, centres: &[(Point, bool)], paper: (f64, f64)) -> Window {
    let of = |needed: bool| centres.iter().filter(move |(_, own)| *own == needed).map(|(at, _)| *at);
    let start = skeleton.inflate(BORDER, BORDER);
    let needed: Vec<Point> = of(true).collect();
    let with_needed = taking_in(start, needed.clone(), skeleton.center(), ABOUT_NEEDED, for_needed(paper));
    let shows = taking_in(with_needed, of(false).collect(), skeleton.center(), BORDER, LARGEST);
    Window::over(shows, &needed)
}

/// How large a figure may be on such paper for the sake of what it needs.
const fn for_needed((width, height): (f64, f64)) -> (f64, f64) {
    (width - AROUND.0, height - AROUND.1)
}

/// A window that has grown over as many places, with so much blank about them, as it takes without becoming larger than
/// `most`; the nearest to a middle first.
pub(super) fn taking_in(
    mut window: Rect,
    mut places: Vec<Point>,
    middle: Point,
    border: f64,
    most: (f64, f64),
) -> Rect {
    places.sort_by(|a, b| a.distance(middle).total_cmp(&b.distance(middle)));
    for at in places {
        let grown = window.union(Rect::from_center_size(at, (2.0 * border, 2.0 * border)));
        if grown.width() <= most.0.max(window.width()) && grown.height() <= most.1.max(window.height()) {
            window = grown;
        }
    }
    window
}

fn on_paper(centre: &Centre) -> Option<Point> {
    match centre.place {
        CentrePlace::At(at) => Some(page(at)),
        CentrePlace::Toward(_) => None,
    }
}

/// How far on a centre lies from the tip of the arrow that leads there, metres.
pub(super) fn further(centre: Rich, metres: f64, notation: &Notation<'_>) -> Rich {
    let distance = human::quantity(metres, &notation.scene.units.length);
    Rich::fill(notation.words.further_to, &[("distance", distance), ("centre", centre)])
}

/// Along a direction of the diagram, on the page.
fn along([x, y]: [f64; 2]) -> Vec2 {
    Vec2::new(x, -y)
}

struct Chart<'a> {
    circle: &'a CircleDiagram,
    notation: Notation<'a>,
    /// Places of the mechanism's points on the page.
    places: &'a [Option<Point>],
    pins: Pins,
    /// The centres within the window by their places, and the spots in which these crowd.
    crowds: &'a [(Point, Vec<&'a Centre>)],
    spots: &'a [Spot<usize>],
    window: Rect,
    metres_per_mm: f64,
    overlay: Overlay,
    births: Option<&'a Births<'a>>,
}

/// A straight line on the page with the centres that lie on it.
struct Ruled {
    through: Point,
    along: Vec2,
    members: Vec<[LinkId; 2]>,
    /// When it was drawn.
    born: Option<Moment>,
}

impl Chart<'_> {
    fn born(&self, links: [LinkId; 2]) -> Option<Moment> {
        self.births.map(|births| moment(self.circle, links, births))
    }

    fn centre(&self, links: [LinkId; 2]) -> Option<&Centre> {
        self.circle.centre(links)
    }

    /// The lines that were drawn, each once with all centres on it.
    fn ruled(&self) -> Vec<Ruled> {
        let mut all: Vec<Ruled> = Vec::new();
        for centre in &self.circle.centres {
            let Found::Kennedy { lines } = centre.found else { continue };
            let [i, j] = centre.links;
            for line in lines {
                let members = match line {
                    CentreLine::Via(k) => vec![chord(i, k), chord(k, j), centre.links],
                    CentreLine::Normal(_) => vec![centre.links],
                };
                let places: Vec<&Centre> = members.iter().filter_map(|m| self.centre(*m)).collect();
                let normal = match line {
                    CentreLine::Normal(slide) => self.normal(slide),
                    CentreLine::Via(_) => None,
                };
                let Some((through, along)) = normal.or_else(|| straight(&places)) else { continue };
                // The line at infinity is not on any paper.
                let same = |r: &&mut Ruled| {
                    (through - r.through).cross(r.along).abs() < COINCIDENT
                        && r.along.cross(along).abs() < 1e-3
                };
                match all.iter_mut().find(same) {
                    Some(ruled) => ruled.members.extend(members),
                    None => all.push(Ruled { through, along, members, born: self.born(centre.links) }),
                }
            }
        }
        all
    }

    /// The common normal of a sliding contact: through the pin, square to the guide.
    fn normal(&self, slide: usize) -> Option<(Point, Vec2)> {
        self.normals().into_iter().find(|(s, ..)| *s == slide).map(|(_, at, along)| (at, along))
    }

    fn normals(&self) -> Vec<(usize, Point, Vec2)> {
        let own = |centre: &Centre| match (centre.found, centre.place) {
            (Found::Kennedy { lines }, CentrePlace::At(at)) => {
                lines.into_iter().find_map(|line| match line {
                    CentreLine::Normal(slide) => {
                        let rider = self.notation.mechanism().slides.get(slide)?.rider;
                        let Rider::Pin { point, .. } = rider else { return None };
                        let pin = self.places.get(point.0).copied().flatten()?;
                        let d = page(at) - pin;
                        (d.hypot() > COINCIDENT).then(|| (slide, pin, d.normalize()))
                    }
                    CentreLine::Via(_) => None,
                })
            }
            _ => None,
        };
        self.circle.centres.iter().filter_map(own).collect()
    }

    fn lines(&mut self) {
        /// Within a name's length, mm.
        const ONE_NAME: f64 = 12.0;
        let mut group = Group::new("lines-of-centres");
        let mut far: Vec<(Point, Rich)> = Vec::new();
        for ruled in self.ruled() {
            let Some((low, high)) = clip_line(ruled.through, ruled.along, self.window) else { continue };
            let t = |at: Point| (at - ruled.through).dot(ruled.along);
            let (mut from, mut to) = (f64::INFINITY, f64::NEG_INFINITY);
            let mut beyond: Vec<(bool, [LinkId; 2])> = Vec::new();
            let mut members = ruled.members.clone();
            members.sort();
            members.dedup();
            for &links in &members {
                let Some(centre) = self.centre(links) else { continue };
                match on_paper(centre) {
                    Some(at) if self.window.contains(at) => {
                        from = from.min(t(at));
                        to = to.max(t(at));
                    }
                    Some(at) => beyond.push((t(at) > 0.0, links)),
                    None => beyond.push((self.freer_end(&ruled, low, high), links)),
                }
            }
            for (forward, _) in &beyond {
                if *forward { to = high } else { from = low }
            }
            if from > to {
                // Nothing of it is on the sheet but the line itself.
                (from, to) = (low, high);
            }
            let reaches = |forward: bool| beyond.iter().any(|(f, _)| *f == forward);
            let from = if reaches(false) { from } else { (from - 4.0).max(low) };
            let to = if reaches(true) { to } else { (to + 4.0).min(high) };
            let at = |t: f64| ruled.through + ruled.along * t;
            let names: Vec<String> = members.iter().map(|m| centre_name(*m, &self.notation)).collect();
            let mut own = Group::new("line-of-centres").data("centres", names.join(" ")).lived(ruled.born);
            own.mark(Mark::stroke(Shape::Line(at(from), at(to)), Pen::solid(FINE)).class("ray").precise());
            for forward in [false, true] {
                if !reaches(forward) {
                    continue;
                }
                let tip = at(if forward { to } else { from });
                let way = if forward { ruled.along } else { -ruled.along };
                own.mark(head(tip, way, HEAD));
                let there: Vec<Rich> = beyond
                    .iter()
                    .filter(|(f, _)| *f == forward)
                    .map(|(_, links)| self.far_name(*links, tip))
                    .collect();
                let text = Rich::join(&there, &Rich::upright(", "));
                // Two lines that leave the paper side by side have one name there.
                let told = |(at, other): &(Point, Rich)| at.distance(tip) < ONE_NAME && *other == text;
                if far.iter().any(told) {
                    continue;
                }
                far.push((tip, text.clone()));
                // Beside the end of its line: beyond it the paper may end.
                let length = text.width(SMALL);
                let beside = Site::Along { from: tip - way * length, to: tip };
                let site = Site::Around { at: tip, radius: 0.6, toward: Some(libm::atan2(-way.y, way.x)) };
                let paper = compose::free_paper(self.notation.scene).0;
                let beyond = self.window.width() + 2.0 * length * way.x.abs() <= paper;
                let (first, second) = if beyond { (site, None) } else { (beside, Some(site)) };
                let mut request = Request::new(text, SMALL, first, "label centre-name").lived(ruled.born);
                request.sites.extend(second);
                request.leader = true;
                self.overlay.labels.push(request);
            }
            group.group(own);
        }
        self.overlay.ink.group(group);
    }

    /// The border of the window that lies nearer to the skeleton's middle has the arrow to infinity.
    fn freer_end(&self, ruled: &Ruled, low: f64, high: f64) -> bool {
        let middle = (self.window.center() - ruled.through).dot(ruled.along);
        high - middle >= middle - low
    }

    /// (16)∞, or (15) with how far it still is.
    fn far_name(&self, links: [LinkId; 2], from: Point) -> Rich {
        let own = name(links, &self.notation);
        match self.centre(links).and_then(on_paper) {
            None => own.up("∞"),
            Some(at) => further(own, at.distance(from) * self.metres_per_mm, &self.notation),
        }
    }

    /// Dots and names; coincident centres have one label. A centre at infinity that no line leads to has an
    /// arrow of its own at its guide.
    fn points(&mut self) {
        let mut group = Group::new("centre-points");
        for (index, (at, crowd)) in self.crowds.iter().enumerate() {
            let at = *at;
            let at_pin = crowd.iter().any(|c| matches!(c.found, Found::Pin(_)));
            let is_pole = crowd.iter().any(|c| c.links[0] == LinkId::FRAME);
            let names: Vec<String> = crowd.iter().map(|c| centre_name(c.links, &self.notation)).collect();
            let born = crowd.iter().filter_map(|c| self.born(c.links)).min();
            let mut own = Group::new("centre").data("centre", names.join(" ")).lived(born);
            if !at_pin {
                if is_pole {
                    let ring = Shape::Circle { centre: at, radius: 1.2 };
                    own.mark(Mark::outlined(ring, Pen::solid(THIN), Tone::Paper).class("pole").precise());
                }
                own.mark(dot(at, 0.55).class("centre").precise());
                group.group(own);
            }
            let bare = at_pin && self.pins == Pins::Bare;
            if bare || self.spots.iter().any(|spot| spot.has(index)) {
                continue;
            }
            let radius = if at_pin { PIN + 0.2 } else { 1.3 };
            let site = Site::Around { at, radius, toward: None };
            let mut request = named(crowd, site, &self.notation).lived(born);
            request.leader = true;
            self.overlay.labels.push(request);
        }
        let (circles, names) = detail::circles(self.spots, |_| None);
        if !self.spots.is_empty() {
            group.group(circles);
            self.overlay.labels.extend(names);
        }
        self.overlay.ink.group(group);
        self.guides_alone();
    }

    /// A primary centre at infinity whose direction no drawn line shows.
    fn guides_alone(&mut self) {
        let drawn: Vec<[LinkId; 2]> = self.ruled().into_iter().flat_map(|r| r.members).collect();
        let mut group = Group::new("centres-at-infinity");
        for centre in &self.circle.centres {
            let (Found::Guide { slide }, CentrePlace::Toward(direction)) = (centre.found, centre.place)
            else {
                continue;
            };
            if drawn.contains(&centre.links) {
                continue;
            }
            let Some(at) = self.rider(slide) else { continue };
            let mut way = along(direction);
            // Upward, else to the right: on either side it is the same centre.
            if way.y > 1e-9 || (way.y.abs() <= 1e-9 && way.x < 0.0) {
                way = -way;
            }
            let (from, to) = (at + way * 3.4, at + way * 12.0);
            let born = self.born(centre.links);
            let mut own = Group::default().lived(born);
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).class("ray"));
            own.mark(head(to, way, HEAD));
            group.adopt(own);
            let text = name(centre.links, &self.notation).up("∞");
            let site = Site::Around { at: to, radius: 0.5, toward: Some(libm::atan2(-way.y, way.x)) };
            let mut request = Request::new(text, SMALL, site, "label centre-name").lived(born);
            request.leader = true;
            self.overlay.labels.push(request);
        }
        self.overlay.ink.group(group);
    }

    fn rider(&self, slide: usize) -> Option<Point> {
        let rider = self.notation.mechanism().slides.get(slide)?.rider;
        let point = match rider {
            Rider::Pin { point, .. } => point,
            Rider::Link { link, .. } => *self.notation.mechanism().links.get(link.0)?.points.first()?,
        };
        self.places.get(point.0).copied().flatten()
    }
}

/// The line through the centres of one triangle: through a finite one, along the widest base or toward one at
/// infinity.
fn straight(members: &[&Centre]) -> Option<(Point, Vec2)> {
    let finite: Vec<Point> = members.iter().filter_map(|c| on_paper(c)).collect();
    let first = *finite.iter().min_by(|a, b| a.to_vec2().hypot().total_cmp(&b.to_vec2().hypot()))?;
    let far = members.iter().find_map(|c| match c.place {
        CentrePlace::Toward(direction) => Some(along(direction)),
        CentrePlace::At(_) => None,
    });
    if let Some(far) = far {
        return Some((first, far));
    }
    let widest = finite.iter().max_by(|a, b| a.distance(first).total_cmp(&b.distance(first)))?;
    let d = *widest - first;
    (d.hypot() > COINCIDENT).then(|| (first, d.normalize()))
}

/// Where a line enters and leaves a rectangle, as lengths from its point.
fn clip_line(through: Point, along: Vec2, window: Rect) -> Option<(f64, f64)> {
    let middle = (window.center() - through).dot(along);
    let reach = window.width() + window.height();
    let at = |t: f64| through + along * t;
    let (low, high) = (middle - reach, middle + reach);
    let (t0, t1) = clip(at(low), at(high), window)?;
    Some((low + (high - low) * t0, low + (high - low) * t1))
}
