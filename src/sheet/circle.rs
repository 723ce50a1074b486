//! The circle diagram: the links on a circle, the centres as chords; a small circle for each step; the triangular
//! table with the found centres struck out; and the steps in words (`s000-ch3b` B).

use kurbo::{Point, Vec2};

use super::figure::{Group, Mark, Pen, Shape, Tone, on_circle};
use super::ink::{FINE, SMALL, THICK, THIN, dot};
use super::notation::Notation;
use super::rich::Rich;
use super::steps::Item;
use crate::graphical::construction::{Centre, CentreLine, CentrePlace, CircleDiagram, Found};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{LinkId, PointId};

/// Radius of the circle.
const RADIUS: f64 = 23.0;
/// Radius of the circle of one step.
const SMALL_RADIUS: f64 = 8.5;
/// From circle to circle of the strip.
const PITCH: f64 = 27.0;
/// Width that the strip fills before it begins a new row.
const STRIP: f64 = 170.0;
/// From entry to entry of the table, across and down.
const CELL: (f64, f64) = (10.5, 6.2);

/// A link-pair's name: (13), or (2,10) where a number has two digits.
#[must_use]
pub fn centre_name(links: [LinkId; 2], notation: &Notation<'_>) -> String {
    let [i, j] = links.map(|l| notation.number(l));
    if i.len() + j.len() > 2 { format!("({i},{j})") } else { format!("({i}{j})") }
}

/// Circle diagram and table side by side, the strip below them.
#[must_use]
pub fn draw(circle: &CircleDiagram, notation: &Notation<'_>) -> Group {
    let mut group = Group::new("circle-diagram").data("count", circle.count().to_string());
    group.title = Some(notation.words.circle_diagram.to_owned());
    group.group(diagram(circle, notation));
    let mut table = table(circle, notation);
    table.translate(Vec2::new(RADIUS + 16.0, -RADIUS - 1.0));
    group.group(table);
    let mut strip = strip(circle, notation);
    let top = group.bounds().map_or(RADIUS, |b| b.y1) + 8.0 + SMALL_RADIUS;
    strip.translate(Vec2::new(-RADIUS + SMALL_RADIUS, top));
    group.group(strip);
    group
}

/// Where the links stand on a circle: the first on top, then clockwise.
fn stations(circle: &CircleDiagram, radius: f64) -> Vec<(LinkId, Point)> {
    let step = std::f64::consts::TAU / circle.links.len().max(1) as f64;
    let at = |i: usize| on_circle(Point::ORIGIN, radius, std::f64::consts::FRAC_PI_2 - step * i as f64);
    circle.links.iter().enumerate().map(|(i, &link)| (link, at(i))).collect()
}

fn ends(stations: &[(LinkId, Point)], links: [LinkId; 2]) -> Option<[Point; 2]> {
    let of = |link: LinkId| stations.iter().find(|(l, _)| *l == link).map(|(_, at)| *at);
    Some([of(links[0])?, of(links[1])?])
}

/// All links, all chords: primary ones thick, constructed ones thin, those not found dashed.
fn diagram(circle: &CircleDiagram, notation: &Notation<'_>) -> Group {
    let stations = stations(circle, RADIUS);
    let mut group = Group::new("chords");
    let ring = Shape::Circle { centre: Point::ORIGIN, radius: RADIUS };
    group.mark(Mark::stroke(ring, Pen::chain(FINE)).class("circle"));
    for (i, (a, _)) in stations.iter().enumerate() {
        for (b, _) in &stations[i + 1..] {
            let links = [*a, *b];
            let Some([from, to]) = ends(&stations, links) else { continue };
            let (class, pen) = match circle.centre(links) {
                Some(centre) if centre.found.is_primary() => ("chord primary", Pen::solid(THICK)),
                Some(_) => ("chord found", Pen::solid(THIN)),
                None => ("chord wanted", Pen::dashed(FINE)),
            };
            let mut chord = Group::new(class).data("centre", centre_name(links, notation));
            chord.mark(Mark::stroke(Shape::Line(from, to), pen));
            group.group(chord);
        }
    }
    number_stations(&mut group, &stations, 3.2, SMALL, notation);
    group
}

fn number_stations(
    group: &mut Group,
    stations: &[(LinkId, Point)],
    gap: f64,
    size: f64,
    notation: &Notation<'_>,
) {
    for (link, at) in stations {
        group.mark(dot(*at, 0.25 * size * 0.8).class("station"));
        let away = at.to_vec2().normalize() * gap;
        let line = Rich::upright(notation.number(*link)).set(size);
        let corner = *at + away - line.ink.center().to_vec2();
        line.put(group, corner, "label link-number");
    }
}

/// One small circle for each constructed centre: what is solid before it, the two triangles, the sought chord.
fn strip(circle: &CircleDiagram, notation: &Notation<'_>) -> Group {
    let stations = stations(circle, SMALL_RADIUS);
    let mut all = Group::new("strip");
    let columns = (STRIP / PITCH).floor();
    let constructed = circle.centres.iter().enumerate().filter(|(_, c)| !c.found.is_primary());
    for (n, (index, centre)) in constructed.enumerate() {
        let mut own = Group::new("step").data("centre", centre_name(centre.links, notation));
        for line in lines_of(centre) {
            let CentreLine::Via(k) = line else { continue };
            let corners = [centre.links[0], k, centre.links[1]];
            let places: Vec<Point> = corners
                .iter()
                .filter_map(|l| stations.iter().find(|(s, _)| s == l).map(|(_, at)| *at))
                .collect();
            own.mark(Mark::area(Shape::Polygon(places), Tone::Tint).class("triangle"));
        }
        let ring = Shape::Circle { centre: Point::ORIGIN, radius: SMALL_RADIUS };
        own.mark(Mark::stroke(ring, Pen::chain(0.13)).class("circle"));
        for known in &circle.centres[..index] {
            let Some([from, to]) = ends(&stations, known.links) else { continue };
            let used = sides(centre).contains(&known.links);
            let pen = Pen::solid(if used { THIN * 1.4 } else { 0.13 });
            own.mark(Mark::stroke(Shape::Line(from, to), pen).class("chord"));
        }
        if let Some([from, to]) = ends(&stations, centre.links) {
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::dashed(THICK)).class("sought"));
        }
        number_stations(&mut own, &stations, 2.4, 2.4, notation);
        let caption = Rich::upright(format!("{}. ", n + 1)).then(&name(centre.links, notation));
        let line = caption.set(SMALL);
        line.put(&mut own, Point::new(-line.width / 2.0, SMALL_RADIUS + 8.2), "label");
        let (column, row) = (n as f64 % columns, (n as f64 / columns).floor());
        own.translate(Vec2::new(column * PITCH, row * (PITCH + 5.0)));
        all.group(own);
    }
    all
}

fn lines_of(centre: &Centre) -> Vec<CentreLine> {
    match centre.found {
        Found::Kennedy { lines } => lines.to_vec(),
        _ => Vec::new(),
    }
}

/// The four sides of the two triangles of a step.
fn sides(centre: &Centre) -> Vec<[LinkId; 2]> {
    let [i, j] = centre.links;
    let of = |line: CentreLine| match line {
        CentreLine::Via(k) => vec![crate::plan::chord(i, k), crate::plan::chord(k, j)],
        CentreLine::Normal(_) => Vec::new(),
    };
    lines_of(centre).into_iter().flat_map(of).collect()
}

/// The triangular table of all centres, the found ones struck out.
fn table(circle: &CircleDiagram, notation: &Notation<'_>) -> Group {
    let mut group = Group::new("centre-table");
    let columns = circle.links.len().saturating_sub(1);
    for (column, link) in circle.links.iter().take(columns).enumerate() {
        let head = Rich::bold(notation.number(*link)).set(SMALL);
        let x = CELL.0 * (column as f64 + 0.5);
        head.put(&mut group, Point::new(x - head.width / 2.0, SMALL), "cell");
        for (row, other) in circle.links[column + 1..].iter().enumerate() {
            let links = [*link, *other];
            let text = name(links, notation).set(SMALL * 0.95);
            let base = SMALL + CELL.1 * (row as f64 + 1.0) + 1.4;
            let mut own = Group::new("entry").data("centre", centre_name(links, notation));
            text.put(&mut own, Point::new(x - text.width / 2.0, base), "cell");
            if circle.centre(links).is_some() {
                // Struck out as by hand; the number stays readable under it.
                let (half, middle) = (text.width / 2.0 + 0.6, base - 0.32 * SMALL);
                let stroke =
                    Shape::Line(Point::new(x - half, middle + 1.3), Point::new(x + half, middle - 1.3));
                let mut mark = Mark::stroke(stroke, Pen::solid(FINE)).class("struck");
                mark.backdrop = true;
                own.mark(mark);
            }
            group.group(own);
        }
    }
    let width = CELL.0 * columns as f64;
    let rule = SMALL + 2.2;
    let line = Shape::Line(Point::new(0.0, rule), Point::new(width, rule));
    group.mark(Mark::stroke(line, Pen::solid(0.25)).class("rule"));
    group
}

/// (13).
#[must_use]
pub fn name(links: [LinkId; 2], notation: &Notation<'_>) -> Rich {
    Rich::upright(centre_name(links, notation))
}

/// The steps of the circle diagram in words; with each the act of marking centres that it tells, the primary ones first.
#[must_use]
pub fn items(circle: &CircleDiagram, notation: &Notation<'_>) -> Vec<(Item, Option<usize>)> {
    let words = notation.words;
    let n = circle.links.len().to_string();
    let mut all = vec![(Item::Head(Rich::bold(words.step_centres)), None)];
    let count = [("n", Rich::upright(&n)), ("count", Rich::upright(circle.count().to_string()))];
    all.push((Item::Sentence(Rich::fill(words.centre_count, &count)), None));
    let listed = |centres: &[&Centre]| {
        let names: Vec<Rich> = centres.iter().map(|c| place_name(c, notation)).collect();
        Rich::join(&names, &Rich::upright(", "))
    };
    let primary: Vec<&Centre> = circle.centres.iter().filter(|c| c.found.is_primary()).collect();
    all.push((Item::Sentence(Rich::fill(words.primary_centres, &[("centres", listed(&primary))])), Some(0)));
    for (index, centre) in circle.centres.iter().filter(|c| !c.found.is_primary()).enumerate() {
        let told = sentence(centre, notation);
        let told = match crossing(circle, centre) {
            Some(crossing) => super::steps::warned(told, crossing, notation),
            None => told,
        };
        all.push((Item::Sentence(told), Some(index + 1)));
    }
    for stalled in &circle.stalled {
        let parts = [("centre", name(*stalled, notation))];
        let told = match circle.still.contains(stalled) {
            true => words.centre_still,
            false => words.centre_stalled,
        };
        all.push((Item::Sentence(Rich::fill(told, &parts)), None));
    }
    all
}

/// The angle at which the two lines of centres cross that lead to a centre, 0 to π/2; none where that is at infinity, and
/// where a line is told otherwise than by two centres.
fn crossing(circle: &CircleDiagram, centre: &Centre) -> Option<f64> {
    let (Found::Kennedy { lines }, CentrePlace::At(_)) = (centre.found, centre.place) else { return None };
    let [i, j] = centre.links;
    let direction = |line: CentreLine| -> Option<[f64; 2]> {
        let CentreLine::Via(k) = line else { return None };
        let ends = [crate::plan::chord(i, k), crate::plan::chord(k, j)];
        match ends.map(|end| circle.centre(end).map(|centre| centre.place)) {
            [Some(CentrePlace::At(a)), Some(CentrePlace::At(b))] => Some([b[0] - a[0], b[1] - a[1]]),
            [Some(CentrePlace::Toward(way)), Some(CentrePlace::At(_))]
            | [Some(CentrePlace::At(_)), Some(CentrePlace::Toward(way))] => Some(way),
            _ => None,
        }
    };
    let ([a, b], [c, d]) = (direction(lines[0])?, direction(lines[1])?);
    let angle = libm::atan2((a * d - b * c).abs(), (a * c + b * d).abs());
    (libm::hypot(a, b) > 0.0 && libm::hypot(c, d) > 0.0).then_some(angle)
}

/// (16)∞, (13).
fn place_name(centre: &Centre, notation: &Notation<'_>) -> Rich {
    let own = name(centre.links, notation);
    if matches!(centre.place, CentrePlace::Toward(_)) { own.up("∞") } else { own }
}

fn sentence(centre: &Centre, notation: &Notation<'_>) -> Rich {
    let words = notation.words;
    let [i, j] = centre.links;
    let own = || name(centre.links, notation);
    let point = |p: PointId| notation.point(p);
    match centre.found {
        Found::Kennedy { lines } => {
            let triangle = |line: CentreLine| match line {
                CentreLine::Via(k) => Some(Rich::upright([i, k, j].map(|l| notation.number(l)).join("-"))),
                CentreLine::Normal(_) => None,
            };
            let line = |line: CentreLine| match line {
                CentreLine::Via(k) => {
                    let ends = [crate::plan::chord(i, k), crate::plan::chord(k, j)];
                    name(ends[0], notation).then(&name(ends[1], notation))
                }
                CentreLine::Normal(slide) => {
                    Rich::fill(words.common_normal, &[("guide", notation.guide(slide))])
                }
            };
            let triangles: Vec<Rich> = lines.into_iter().filter_map(triangle).collect();
            let template = match centre.place {
                CentrePlace::At(_) => words.centre_meet,
                CentrePlace::Toward(_) => words.centre_parallel,
            };
            let parts = [
                ("centre", own()),
                ("triangles", Rich::join(&triangles, &Rich::upright(words.and))),
                ("first", line(lines[0])),
                ("second", line(lines[1])),
            ];
            Rich::fill(template, &parts)
        }
        Found::Normal { point: p, link, from, assumed } => {
            let (velocity, omega) = if from == LinkId::FRAME {
                (Quantity::Velocity(p), Quantity::Omega(link))
            } else {
                (Quantity::Slip(p, from), Quantity::RelativeOmega(link, from))
            };
            let parts = [
                ("centre", own()),
                ("velocity", notation.symbol(velocity, false)),
                ("point", point(p)),
                ("omega", notation.symbol(omega, false)),
            ];
            let template = if assumed { words.centre_at_rest } else { words.centre_by_velocity };
            Rich::fill(template, &parts)
        }
        Found::Pin(_) | Found::Guide { .. } | Found::ArcGuide { .. } | Found::Rolling { .. } => own(),
    }
}
