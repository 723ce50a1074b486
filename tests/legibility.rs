//! What a reader finds on a finished sheet, told from its ink alone: whether everything has its name, how near to each
//! other points stand, how large the diagrams are, how full the pages, whether any text touches anything, and whether every
//! printed line gives its own printed result.
//!
//! `cargo test --test legibility -- --nocapture` prints the distribution over all examples, the catalogue and random
//! chains.

#![allow(clippy::unwrap_used, reason = "a test says no more than that it failed")]

use crate::{common, sheets};

use std::collections::{HashMap, HashSet};

use common::chains::chains;
use kurbo::{Point, Rect};
use linkgram::catalogue::KINDS;
use linkgram::mechanism::quantity::Answer;
use linkgram::plan::Extent;
use linkgram::scene::Scene;
use linkgram::sheet::figure::{Group, Mark, Node, Shape, Text};
use linkgram::sheet::overlap::overlaps;
use linkgram::sheet::{self, Figure, Language};
use proptest::prelude::*;
use proptest::strategy::ValueTree;
use proptest::test_runner::TestRunner;

/// A vector of this length has a name, mm.
const NAMED: f64 = 3.0;
/// A head with its equation and what follows is not parted, mm.
const CHUNK: f64 = 30.0;
/// Random chains among the sheets that are read.
const CHAINS: usize = 12;

fn solution(scene: &Scene) -> Option<Figure> {
    let solved = linkgram::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).ok()?;
    Some(sheet::solution(scene, &solved.solution.construction, Language::English))
}

/// The sheets that are read, with their names.
pub(crate) fn all() -> Vec<(String, Figure)> {
    let examples = sheets::examples().into_iter().map(|example| {
        let text = std::fs::read_to_string(&example.path).unwrap();
        (example.name.clone(), linkgram::scene::read(&text, &example.name).unwrap())
    });
    let kinds = KINDS.iter().map(|kind| {
        (format!("catalogue {}", kind.name), linkgram::scene::read(kind.scene, kind.name).unwrap())
    });
    let mut runner = TestRunner::deterministic();
    let random = (0..CHAINS).map(|i| {
        let chain = chains().new_tree(&mut runner).unwrap().current();
        (format!("chain {i}"), common::read(&chain.text))
    });
    let constructions = ["klein", "inflection", "two-positions"]
        .map(|name| (format!("constructions/{name}"), common::example(&format!("constructions/{name}"))));
    let forces = ["1", "2", "16", "20", "21"].map(|number| format!("forces/s000-ch5-{number}"));
    let forces = forces.map(|name| (name.clone(), common::example(&name)));
    let scenes: Vec<(String, Scene)> =
        examples.chain(kinds).chain(random).chain(constructions).chain(forces).collect();
    scenes.iter().filter_map(|(name, scene)| Some((name.clone(), solution(scene)?))).collect()
}

pub(crate) fn data<'a>(group: &'a Group, name: &str) -> Option<&'a str> {
    group.data.iter().find(|(own, _)| *own == name).map(|(_, value)| value.as_str())
}

pub(crate) fn has(group: &Group, class: &str) -> bool {
    group.class.split(' ').any(|own| own == class)
}

/// All groups within a group, itself among them.
fn groups<'a>(group: &'a Group, all: &mut Vec<&'a Group>) {
    all.push(group);
    for child in &group.children {
        if let Node::Group(child) = child {
            groups(child, all);
        }
    }
}

pub(crate) fn within(group: &Group) -> Vec<&Group> {
    let mut all = Vec::new();
    groups(group, &mut all);
    all
}

pub(crate) fn marks(group: &Group) -> impl Iterator<Item = &Mark> {
    group.children.iter().filter_map(|node| match node {
        Node::Mark(mark) => Some(mark),
        _ => None,
    })
}

/// Tail and tip of a drawn vector.
fn ends(vector: &Group) -> Option<(Point, Point)> {
    let tail = marks(vector).find_map(|mark| match mark.shape {
        Shape::Line(from, _) if mark.class == "shaft" => Some(from),
        _ => None,
    });
    let tip = marks(vector).find_map(|mark| match &mark.shape {
        Shape::Polygon(corners) if mark.class == "head" => corners.first().copied(),
        _ => None,
    });
    tail.zip(tip)
}

fn place(point: &Group) -> Option<Point> {
    marks(point).find_map(|mark| match mark.shape {
        Shape::Circle { centre, .. } => Some(centre),
        _ => None,
    })
}

/// What was found on a diagram.
#[derive(Debug, Default)]
struct Seen {
    vectors: usize,
    unnamed: Vec<String>,
    closest: Option<f64>,
    size: f64,
}

fn see(diagram: &Group) -> Seen {
    let all = within(diagram);
    let names: HashSet<&str> = all
        .iter()
        .filter(|group| has(group, "name"))
        .flat_map(|group| data(group, "of").unwrap_or_default().split(' '))
        .collect();
    let mut seen = Seen::default();
    let mut points: Vec<Point> = Vec::new();
    let mut bounds: Option<Rect> = None;
    for group in &all {
        let what: Vec<&str> = if has(group, "vector") {
            let Some((tail, tip)) = ends(group) else { continue };
            let own = Rect::from_points(tail, tip);
            bounds = Some(bounds.map_or(own, |all| all.union(own)));
            if tail.distance(tip) < NAMED {
                continue;
            }
            seen.vectors += 1;
            data(group, "quantity").into_iter().collect()
        } else if let (true, Some(name)) = (has(group, "image") || has(group, "joint"), data(group, "point"))
        {
            points.extend(place(group));
            vec![name]
        } else if let (true, Some(number)) = (has(group, "link"), data(group, "link")) {
            vec![number]
        } else if let (true, Some(centres)) = (has(group, "centre"), data(group, "centre")) {
            centres.split(' ').collect()
        } else {
            continue;
        };
        let missing = what.into_iter().flat_map(|what| what.split(' ')).filter(|what| !names.contains(what));
        seen.unnamed.extend(missing.map(|what| format!("{} {what}", group.class)));
    }
    for (i, a) in points.iter().enumerate() {
        for b in &points[..i] {
            let apart = a.distance(*b);
            if apart > 0.05 {
                seen.closest = Some(seen.closest.map_or(apart, |least| least.min(apart)));
            }
        }
    }
    seen.size = bounds.map_or(0.0, |all| all.width().max(all.height()));
    seen
}

/// How much of each page is used, from its top down, as a part of what is within the margins; and its blank, mm.
fn pages(figure: &Figure) -> Vec<(f64, f64)> {
    const MARGIN: f64 = 17.0;
    let all: Vec<&Group> = within(&figure.root).into_iter().filter(|group| has(group, "page")).collect();
    let height = figure.height / all.len().max(1) as f64;
    let used = |(i, page): (usize, &&Group)| {
        let boxes = page.children.iter().filter_map(|node| match node {
            Node::Group(group) => group.bounds(),
            Node::Text(text) if text.class == "page-number" => None,
            Node::Text(text) => text.bounds(),
            Node::Mark(mark) => Some(mark.bounds()),
        });
        let top = i as f64 * height + MARGIN;
        let bottom = boxes.map(|own| own.y1).fold(top, f64::max);
        let whole = height - 2.0 * MARGIN - 3.0;
        ((bottom - top) / whole, whole - (bottom - top))
    };
    all.iter().enumerate().map(used).collect()
}

fn quantiles(what: &str, mut values: Vec<f64>) {
    values.sort_by(f64::total_cmp);
    let at = |part: f64| values[((values.len() - 1) as f64 * part) as usize];
    let list = [0.0, 0.1, 0.25, 0.5, 0.75, 1.0].map(|part| format!("{:.2}", at(part)));
    println!("{what}: {} of {}", list.join(" "), values.len());
}

#[test]
fn everything_has_its_name_and_no_page_stands_nearly_empty() {
    let (mut vectors, mut unnamed, mut waste, mut touching) = (0, Vec::new(), Vec::new(), Vec::new());
    let (mut closest, mut sizes, mut fills, mut last) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (name, figure) in all() {
        for diagram in within(&figure.root) {
            let polygon = has(diagram, "polygon");
            if !polygon && !has(diagram, "skeleton") && !has(diagram, "instant-centres") {
                continue;
            }
            let seen = see(diagram);
            vectors += seen.vectors;
            unnamed.extend(seen.unnamed.iter().map(|what| format!("{name}: {}: {what}", diagram.class)));
            if polygon {
                closest.extend(seen.closest);
                sizes.push(seen.size);
            }
        }
        touching.extend(overlaps(&figure).into_iter().map(|overlap| format!("{name}: {overlap:?}")));
        let pages = pages(&figure);
        for (i, (fill, blank)) in pages.iter().enumerate() {
            fills.push(*fill);
            let used = blank * fill / (1.0 - fill).max(1e-9);
            let elsewhere = pages.iter().enumerate().any(|(k, (_, blank))| k != i && *blank > used + CHUNK);
            if *fill < 1.0 / 3.0 && elsewhere {
                waste.push(format!("{name}: page {} of {}, {:.0} %", i + 1, pages.len(), 100.0 * fill));
            }
        }
        last.extend(pages.last().filter(|_| pages.len() > 1).map(|(fill, _)| *fill));
    }
    println!("vectors of {NAMED} mm and more: {vectors}, without a name: {}", unnamed.len());
    quantiles("closest distinct points of a polygon, mm", closest);
    quantiles("larger side of a polygon, mm", sizes);
    quantiles("fill of a page", fills);
    // Where nothing else can be done some lines stand alone on a last page.
    let thin = last.iter().filter(|fill| **fill < 1.0 / 3.0).count();
    println!("last pages less than a third full: {thin} of {}", last.len());
    assert!(40 * thin <= last.len(), "{thin} of {}: {last:?}", last.len());
    quantiles("fill of the last of several pages", last);
    assert!(unnamed.is_empty(), "{unnamed:#?}");
    assert!(touching.is_empty(), "{touching:#?}");
    assert!(waste.is_empty(), "{waste:#?}");
}

/// The characters of a line, with exponents and indices told from what stands beside them.
pub(crate) fn characters(text: &Text) -> String {
    let size = text.runs.iter().map(|run| run.size).fold(0.0, f64::max);
    let base = text.runs.iter().map(|run| run.at.y).fold(f64::NEG_INFINITY, f64::max);
    let full = text.runs.iter().find(|run| run.size >= 0.9 * size);
    let line = full.map_or(base, |run| run.at.y);
    text.runs
        .iter()
        .map(|run| {
            let small = run.size < 0.9 * size;
            if small && run.at.y < base - 0.1 * size {
                format!("^{}", run.text)
            } else if small && run.at.y > line + 0.05 * size {
                format!("_{}", run.text)
            } else {
                run.text.clone()
            }
        })
        .collect()
}

/// The sentences of the steps, each in one line.
pub(crate) fn sentences(figure: &Figure) -> Vec<String> {
    let mut all: Vec<String> = Vec::new();
    for group in within(&figure.root) {
        if !has(group, "sentence") {
            continue;
        }
        let texts: Vec<&Text> = group
            .children
            .iter()
            .filter_map(|node| match node {
                Node::Text(text) => Some(text),
                _ => None,
            })
            .collect();
        let begins = texts.iter().any(|text| text.class == "mark");
        let line: String = texts.iter().filter(|text| text.class != "mark").map(|t| characters(t)).collect();
        match all.last_mut() {
            Some(last) if !begins => {
                last.push(' ');
                last.push_str(&line);
            }
            _ => all.push(line),
        }
    }
    all
}

/// A printed number at the beginning, half a unit of its last place, and what stands after it.
pub(crate) fn number(text: &str) -> Option<(f64, f64, &str)> {
    let text = text.trim_start();
    let sign = if text.starts_with('−') { -1.0 } else { 1.0 };
    let body = text.trim_start_matches('−');
    let end = body
        .char_indices()
        .find(|(_, c)| !c.is_ascii_digit() && *c != '.' && *c != '\u{2009}')
        .map_or(body.len(), |(i, _)| i);
    let digits: String = body[..end].chars().filter(|c| *c != '\u{2009}').collect();
    let mut value: f64 = digits.trim_end_matches('.').parse().ok()?;
    let places = digits.split_once('.').map_or(0, |(_, after)| after.len());
    let mut half = format!("0.5e-{places}").parse().ok()?;
    if places == 0 && value >= 10_000.0 {
        // Four figures stand there, and noughts.
        half = format!("0.5e{}", digits.len() - 4).parse().ok()?;
    }
    let mut rest = &body[end..];
    let power = rest.trim_start_matches(['\u{a0}', ' ']);
    if let Some(power) = power.strip_prefix("×\u{a0}10^") {
        let end = power.find(|c: char| !c.is_ascii_digit() && c != '−').unwrap_or(power.len());
        let exponent: i32 = power[..end].replace('−', "-").parse().ok()?;
        let power_of_ten: f64 = format!("1e{exponent}").parse().ok()?;
        value *= power_of_ten;
        half *= power_of_ten;
        rest = &power[end..];
    }
    Some((sign * value, half, rest))
}

/// A line without the units and senses that stand in it, its points as crosses: `4 rad/s ccw · 72.3 mm / 182 mm`.
fn without_units(text: &str) -> String {
    let mut text = text.replace(" ·", " ×").replace("\u{a0}·", "\u{a0}×");
    let of_forces = [
        "kg·m²", "N·mm", "N·cm", "N·m", "N/mm", "N/m", "rad/s²", "m/s²", "lbf", "kgf", "kN", "kg", "Pa", "m²",
    ];
    let of_motion = ["rad/s", "mm/s", "cm/s", "km/s", "m/s", "ccw", "cw", "mm", "cm"];
    for unit in of_forces.into_iter().chain(of_motion).chain(["N", "m"]) {
        for blank in [" ", "\u{a0}"] {
            text =
                text.replace(&format!("{blank}{unit} "), " ").replace(&format!("{blank}{unit}\u{a0}"), " ");
            text = text.strip_suffix(&format!("{blank}{unit}")).map_or(text.clone(), str::to_owned);
        }
    }
    text
}

/// The value of `2 × 3.1² / 4` or `(400 × 61.3 − 40 × 20.1) / 125`, numbers only; `None` of anything else, and of a single
/// number.
pub(crate) fn reckoned(text: &str) -> Option<f64> {
    let text = without_units(text).replace("2π", "6.283185307179586").replace('π', "3.141592653589793");
    let mut reading = Reckoning { rest: &text, operations: 0 };
    let value = reading.sum()?;
    (reading.rest.trim().is_empty() && reading.operations > 0).then_some(value)
}

struct Reckoning<'a> {
    rest: &'a str,
    operations: usize,
}

impl Reckoning<'_> {
    fn take(&mut self, signs: &[char]) -> Option<char> {
        let rest = self.rest.trim_start();
        let sign = rest.chars().next().filter(|sign| signs.contains(sign))?;
        self.rest = &rest[sign.len_utf8()..];
        Some(sign)
    }

    fn sum(&mut self) -> Option<f64> {
        let mut value = self.product()?;
        while let Some(sign) = self.take(&['+', '−']) {
            self.operations += 1;
            let next = self.product()?;
            value += if sign == '+' { next } else { -next };
        }
        Some(value)
    }

    fn product(&mut self) -> Option<f64> {
        let mut value = self.factor()?;
        while let Some(sign) = self.take(&['×', '/']) {
            self.operations += 1;
            let next = self.factor()?;
            value = if sign == '×' { value * next } else { value / next };
        }
        Some(value)
    }

    fn factor(&mut self) -> Option<f64> {
        let root = self.take(&['√']).is_some();
        let value = if self.take(&['(']).is_some() {
            let inside = self.sum()?;
            self.take(&[')'])?;
            self.operations += usize::from(root);
            if root { libm::sqrt(inside) } else { inside }
        } else {
            let (own, _, after) = number(self.rest)?;
            self.rest = after;
            own
        };
        if self.take(&['²']).is_some() {
            self.operations += 1;
            return Some(value * value);
        }
        Some(value)
    }
}

#[test]
fn every_printed_line_gives_its_printed_result() {
    let (mut lines, mut carried, mut open, mut empty) = (0, 0, Vec::new(), Vec::new());
    for (name, figure) in all() {
        for sentence in sentences(&figure) {
            let parts: Vec<&str> = sentence.split('=').collect();
            for pair in parts.windows(2) {
                let Some(value) = reckoned(pair[0].rsplit(':').next().unwrap()) else { continue };
                let Some((printed, half, _)) = number(pair[1]) else { continue };
                lines += 1;
                // Half way goes up, away from zero.
                let off = (value - printed) * printed.signum() / half;
                if !(-1.0 - 1e-6..1.0 - 1e-6).contains(&off) && value != printed {
                    open.push(format!("{name}: {sentence}"));
                }
                carried += usize::from(sentence.contains('·') && !sentence.contains('²'));
                if sentence.contains(": 0.0\u{a0}mm") && printed != 0.0 {
                    empty.push(format!("{name}: {sentence}"));
                }
            }
        }
    }
    println!("{lines} lines, {} do not close", open.len());
    assert!(lines > 1000, "{lines}");
    assert!(carried > 20, "velocities carried over by centres are reckoned again: {carried}");
    assert!(open.is_empty(), "{} of {lines}: {open:#?}", open.len());
    assert!(empty.is_empty(), "{empty:#?}");
}

/// The distance of a box from a stroke, by points of the stroke.
fn gap(own: Rect, (a, b): (Point, Point)) -> f64 {
    let apart = |p: Point| {
        let dx = (own.x0 - p.x).max(p.x - own.x1).max(0.0);
        let dy = (own.y0 - p.y).max(p.y - own.y1).max(0.0);
        libm::hypot(dx, dy)
    };
    (0..=200).map(|i| apart(a.lerp(b, f64::from(i) / 200.0))).fold(f64::INFINITY, f64::min)
}

fn nearest(p: Point, (a, b): (Point, Point)) -> Point {
    let d = b - a;
    a.lerp(b, ((p - a).dot(d) / d.hypot2().max(1e-12)).clamp(0.0, 1.0))
}

fn cross(a: Point, b: Point, (c, d): (Point, Point)) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

/// The names of a polygon that stand at another vector or point than their own, or whose leader ends there.
fn misplaced(diagram: &Group) -> Vec<String> {
    /// Closer than this to its own a name is its, whatever else is as near.
    const AT: f64 = 1.0;
    let outside = |group: &&&Group| !has(group, "detail");
    let own: Vec<&Group> = diagram
        .children
        .iter()
        .filter_map(|node| match node {
            Node::Group(group) => Some(group),
            _ => None,
        })
        .filter(|group| outside(&group))
        .flat_map(within)
        .collect();
    let vectors: Vec<(&str, (Point, Point))> = own
        .iter()
        .filter(|group| has(group, "vector"))
        .filter_map(|group| Some((data(group, "quantity")?, ends(group)?)))
        .collect();
    let points: Vec<(&str, Point)> = own
        .iter()
        .filter(|group| has(group, "image"))
        .filter_map(|group| Some((data(group, "point")?, place(group)?)))
        .collect();
    let mut wrong = Vec::new();
    for name in own.iter().filter(|group| has(group, "name")) {
        let of: Vec<&str> = data(name, "of").unwrap_or_default().split(' ').collect();
        let texts = || {
            name.children.iter().filter_map(|node| match node {
                Node::Text(text) => Some(text),
                _ => None,
            })
        };
        let Some(own) = texts().filter_map(Text::bounds).reduce(|a, b| a.union(b)) else { continue };
        let leader = marks(name).find_map(|mark| match mark.shape {
            Shape::Line(from, _) if mark.class == "leader" => Some(from),
            _ => None,
        });
        if texts().any(|text| text.class.contains("vector-name")) {
            let (mine, others): (Vec<_>, Vec<_>) = vectors.iter().partition(|(what, _)| of.contains(what));
            if let Some(end) = leader {
                let far =
                    mine.iter().map(|(_, v)| nearest(end, *v).distance(end)).fold(f64::INFINITY, f64::min);
                if far > 0.3 {
                    wrong.push(format!("{of:?}: its leader ends {far:.1} mm from it"));
                }
                continue;
            }
            let centre = own.center();
            let Some((_, to)) = mine.iter().min_by(|a, b| {
                let far = |v: &(&str, (Point, Point))| nearest(centre, v.1).distance(centre);
                far(a).total_cmp(&far(b))
            }) else {
                continue;
            };
            let clear = mine.iter().map(|(_, v)| gap(own, *v)).fold(f64::INFINITY, f64::min);
            let foot = centre.lerp(nearest(centre, *to), 0.93);
            for (other, v) in others {
                let far = gap(own, v);
                if clear > AT && far < clear - 0.3 {
                    wrong.push(format!("{of:?}: {clear:.1} mm from its own, {far:.1} mm from {other}"));
                } else if cross(centre, foot, v) {
                    wrong.push(format!("{of:?} stands behind {other}"));
                }
            }
        } else if texts().any(|text| text.class.contains("image-name")) {
            let mine: Vec<Point> = points.iter().filter(|(p, _)| of.contains(p)).map(|(_, at)| *at).collect();
            let from = |at: Point, p: Point| at.distance(p);
            let apart = |p: &Point| mine.iter().all(|own| own.distance(*p) > 0.8);
            let others = || points.iter().filter(|(p, at)| !of.contains(p) && apart(at));
            let (clear, reach): (f64, Box<dyn Fn(Point) -> f64>) = match leader {
                Some(end) => {
                    let far = mine.iter().map(|p| from(end, *p)).fold(f64::INFINITY, f64::min);
                    (far, Box::new(move |p| from(end, p)))
                }
                None => {
                    let far = mine.iter().map(|p| gap(own, (*p, *p))).fold(f64::INFINITY, f64::min);
                    (far, Box::new(move |p| gap(own, (p, p))))
                }
            };
            let near = others().find(|(_, p)| reach(*p) < clear - 0.2);
            // What lies out of the window has its name where the line to it leaves.
            if let Some((other, _)) = near.filter(|_| clear.is_finite()) {
                wrong.push(format!("{of:?} stands at {other}"));
            }
        }
    }
    wrong
}

/// Each name is nearer to what it names than to any other vector or point, and stands behind none; or a leader ties it.
#[test]
fn every_name_stands_at_its_own_vector_or_point() {
    let (mut polygons, mut wrong) = (0, Vec::new());
    for (name, figure) in all() {
        for diagram in within(&figure.root).into_iter().filter(|group| has(group, "polygon")) {
            polygons += 1;
            wrong.extend(misplaced(diagram).into_iter().map(|what| format!("{name}: {what}")));
        }
    }
    assert!(polygons > 200, "{polygons}");
    assert!(wrong.is_empty(), "{} of {polygons} polygons: {wrong:#?}", wrong.len());
}

/// What a line says: of what, by which symbols, with which numbers.
fn formula(sentence: &str) -> Option<(String, Vec<String>, Vec<String>, String)> {
    let parts: Vec<&str> = sentence.split('=').map(str::trim).collect();
    let [of, symbols, numbers, result] = parts[..] else { return None };
    let tidy = |text: &str| text.replace("^2", "").trim_matches([' ', '\u{a0}']).to_owned();
    let cut = |text: &str, signs: [char; 2]| -> Vec<String> {
        text.split(signs).map(tidy).map(|part| part.trim_end_matches('²').to_owned()).collect()
    };
    Some((tidy(of), cut(symbols, ['/', '·']), cut(numbers, ['/', '×']), result.to_owned()))
}

/// The number at the beginning of a text as it is printed, and its unit.
fn printed(text: &str) -> Option<(String, String)> {
    let (.., rest) = number(text)?;
    let own = text[..text.len() - rest.len()].trim();
    let unit = rest.split([' ', '\u{a0}', '.']).find(|word| !word.is_empty()).unwrap_or_default();
    (!own.is_empty()).then(|| (own.to_owned(), unit.trim_end_matches([',', ';']).to_owned()))
}

/// The last number of a line, and the symbol with the number with which the line begins to reckon: ω_2 and 3.142 of
/// `ω_4 = ω_2 · (12–24) / (14–24) = 3.142 rad/s · 83.9 mm / 123.9 mm = …`, ω_2 of `ω_2 = 2π × 30 / 60 = 3.142 rad/s`.
fn rates_of(sentence: &str) -> (Option<[String; 2]>, Option<[String; 2]>) {
    let line = sentence.rsplit(": ").next().unwrap_or(sentence);
    let parts: Vec<&str> = line.split('=').map(str::trim).collect();
    let symbol = |text: &str| {
        let own = text.split([' ', '\u{a0}']).next().unwrap_or_default();
        own.starts_with('ω').then(|| own.to_owned())
    };
    let told = match parts[..] {
        [of, .., result] => symbol(of).zip(printed(result)).map(|(of, (number, _))| [of, number]),
        _ => None,
    };
    let used = match parts[..] {
        [_, symbols, numbers, _] => {
            symbol(symbols).zip(printed(numbers)).map(|(of, (number, _))| [of, number])
        }
        _ => None,
    };
    (told, used)
}

/// A line uses a value as the reading or the line before it printed it.
#[test]
fn one_value_has_one_print() {
    let (mut uses, mut rates, mut wrong) = (0, 0, Vec::new());
    // Constructions on the skeleton have lines of their own.
    for (name, figure) in all().into_iter().filter(|(name, _)| !name.starts_with("constructions/")) {
        let mut told: HashMap<String, (String, String)> = HashMap::new();
        let mut turning: HashMap<String, String> = HashMap::new();
        for sentence in sentences(&figure) {
            let (own, used) = rates_of(&sentence);
            if let Some([of, number]) = used
                && let Some(before) = turning.get(&of)
            {
                rates += 1;
                if *before != number {
                    wrong.push(format!("{name}: {sentence}, but {of} was {before}"));
                }
            }
            if let Some([of, number]) = own {
                turning.entry(of).or_insert(number);
            }
            if let Some((of, symbols, numbers, result)) = formula(&sentence) {
                if symbols.len() == numbers.len() {
                    for (symbol, number) in symbols.iter().zip(&numbers) {
                        let Some((before, _)) = told.get(symbol) else { continue };
                        uses += 1;
                        // Where units do not go together each number has its own.
                        let own = printed(number).map_or(number.clone(), |(own, _)| own);
                        if *before != own {
                            wrong.push(format!("{name}: {sentence}, but {symbol} was {before}"));
                        }
                    }
                }
                if let Some(result) = printed(&result) {
                    told.entry(of).or_insert(result);
                }
            } else if let Some(read) = sentence.strip_prefix("Read ")
                && let Some((of, _)) = read.split_once('=')
                && let Some(result) = read.rsplit('=').next().and_then(printed)
            {
                told.entry(of.trim_matches([' ', '\u{a0}']).to_owned()).or_insert(result);
            }
        }
    }
    println!("{uses} uses, {rates} of rates");
    assert!(uses > 500 && rates > 20, "{uses} uses, {rates} of rates");
    assert!(wrong.is_empty(), "{} of {uses}: {wrong:#?}", wrong.len());
}

/// No table passes the margins, and no two stand on each other, on any paper and in any language.
#[test]
fn tables_keep_within_the_margins_of_every_paper() {
    /// The margin, less what a rounding takes.
    const MARGIN: f64 = 16.9;
    let (mut tables, mut wrong) = (0, Vec::new());
    for (i, kind) in KINDS.iter().enumerate() {
        let mut scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
        for (j, paper) in ["A5", "A6", "A4", "A5 landscape", "A3"].into_iter().enumerate() {
            // All kinds on the paper that is narrow for a table, some on every other.
            if j > 0 && i % 5 != j {
                continue;
            }
            scene.sheet.paper = Some(paper.to_owned());
            let Ok(solved) = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene)
            else {
                continue;
            };
            let languages = [Language::English, Language::Arabic, Language::Persian];
            for language in languages.into_iter().take(if i % 4 == 0 { 3 } else { 1 }) {
                let figure = sheet::solution(&scene, &solved.solution.construction, language);
                let found = within(&figure.root);
                let own: Vec<Rect> = found
                    .iter()
                    .filter(|group| has(group, "results"))
                    .filter_map(|group| group.bounds())
                    .collect();
                tables += own.len();
                let out = own.iter().filter(|own| own.x0 < MARGIN || own.x1 > figure.width - MARGIN).count();
                let over = own
                    .iter()
                    .enumerate()
                    .filter(|(k, a)| own[..*k].iter().any(|b| !a.intersect(*b).is_zero_area()))
                    .count();
                if out + over > 0 {
                    wrong.push(format!("{} on {paper} {language:?}: {out} out, {over} on others", kind.name));
                }
            }
        }
    }
    assert!(tables > 60, "{tables}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A block on an arc of the frame, and one in a curved slot of a yoke that does not turn, of which the rates are asked.
const ARCS: [&str; 2] = [
    r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": ["A", "B"], "length": 120}},
    "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "centre": [120, -200], "radius": 260}}],
    "near": {"B": [145, 60]}, "input": {"link": 2, "angle": 50, "omega": "10 rad/s ccw", "alpha": 5},
    "find": ["v(B)", "a(B)", "omega(4)", "alpha(4)"]}"#,
    r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 40}, "4": {"joins": ["C", "D"], "length": 90}},
    "slides": [{"link": 4, "on": {"link": 1, "through": "O2", "angle": 0}},
               {"pin": "A", "block": 3, "on": {"link": 4, "centre": [-70, 0], "radius": 80}}],
    "near": {"C": [20, 0]}, "input": {"link": 2, "angle": 60, "omega": "10 rad/s ccw", "alpha": 4},
    "find": ["v(A)", "v(D)", "omega(3)", "a(D)", "alpha(3)"]}"#,
];

/// A four-bar of which everything is asked that follows from rates, vectors and the skeleton.
const FURTHER: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [110, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 40},
              "3": {"joins": ["A", "B", "C"], "sides": [120, 70, 80], "turn": "cw"},
              "4": {"joins": ["O4", "B"], "length": 80}},
    "near": {"B": [130, 75]}, "input": {"link": 2, "angle": 60, "omega": "120 rpm ccw"},
    "find": ["x(B)", "angle(3)", "transmission(3/4)", "rho(C)", "omega(3/2)", "omega(4/3)", "alpha(4/3)", "ratio(4/2)",
             "v(C)", "a(C)"]}"#;

/// A crank and slotted lever of which the rates of the block are asked.
const BLOCK: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 160], "O4": [0, 0]},
    "links": {"2": {"joins": ["O2", "A"], "length": 60}, "4": {"joins": ["O4", "B"], "length": 340}},
    "slides": [{"pin": "A", "block": 3, "on": {"link": 4, "through": "O4", "toward": "B"}}],
    "near": {"B": [100, 320]}, "input": {"link": 2, "angle": 25, "omega": "60 rpm ccw"},
    "find": ["omega(3)", "alpha(3)", "omega(4)", "alpha(4)"]}"#;

/// Every row of the result table has a line that gives it.
#[test]
fn what_is_asked_is_told_in_a_step() {
    let oldham = KINDS.iter().find(|kind| kind.name == "oldham").unwrap().scene;
    for text in [FURTHER, BLOCK, ARCS[0], ARCS[1], oldham] {
        let figure = solution(&linkgram::scene::read(text, "test").unwrap()).unwrap();
        let told = sentences(&figure).join(" ");
        let mut rows = 0;
        for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
            let cells: Vec<(&Text, String)> = table
                .children
                .iter()
                .filter_map(|node| match node {
                    Node::Text(text) => Some((text, characters(text))),
                    _ => None,
                })
                .collect();
            // The head, then rows of a symbol, a value and a sense.
            let heights: Vec<f64> = cells.iter().map(|(text, _)| text.runs[0].at.y).collect();
            for (i, (_, symbol)) in cells.iter().enumerate().skip(3) {
                let first = heights[..i].last().is_none_or(|above| heights[i] > above + 2.0);
                if first {
                    rows += 1;
                    // What is zero needs no number.
                    if cells
                        .get(i + 1)
                        .is_some_and(|(_, value)| value.starts_with("0 ") || value.starts_with("0\u{a0}"))
                    {
                        continue;
                    }
                    let gives =
                        [format!("{symbol}\u{a0}="), format!("{symbol} ="), format!("{symbol}\u{a0}(")];
                    assert!(gives.iter().any(|line| told.contains(line)), "{symbol}: {told}");
                }
            }
        }
        assert!(rows >= 4, "{rows}");
    }
    // ρ = V²/Aⁿ and the difference of two rates, reckoned again by the test of all lines.
    let figure = solution(&linkgram::scene::read(FURTHER, "test").unwrap()).unwrap();
    let lines = sentences(&figure);
    for begin in ["ρ_C", "ω_32", "ω_43"] {
        let line = lines.iter().find(|line| line.starts_with(begin)).unwrap();
        let parts: Vec<&str> = line.split('=').collect();
        let reckoned = reckoned(parts[parts.len() - 2]).unwrap();
        let (printed, half, _) = number(parts[parts.len() - 1]).unwrap();
        assert!((reckoned - printed).abs() <= half * (1.0 + 1e-9), "{line}");
    }
}

const WHEEL_ON_A_RAIL: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]}, "links": {
    "2": {"joins": ["O2", "A"], "length": 40}, "3": {"joins": ["A", "C"], "length": 150}, "4": {"joins": ["C"]}},
    "rolls": [{"links": [1, 4], "line": {"link": 1, "through": [0, -50], "angle": 0}, "centre": "C", "radius": 50}],
    "near": {"C": [180, 0]}, "gravity": {}, "masses": {"4": {"mass": 20, "inertia": 0.025}},
    "input": {"link": 2, "angle": 50, "omega": "10 rad/s ccw"},
    "loads": [{"on": 4, "at": "C", "force": 60, "direction": 180, "name": "P"}],
    "find": ["T(2)", "F(2,3)", "F(3,4)", "F(1,4)"]}"#;

/// Every row of a table with a number has a step that states it: `F_14 = `, also of parts of forces and of a force of which
/// moments give both parts.
#[test]
fn every_row_of_a_table_has_a_step_that_states_it() {
    let rail = linkgram::scene::read(WHEEL_ON_A_RAIL, "test").unwrap();
    let sheets = all().into_iter().filter(|(name, _)| !name.starts_with("chain "));
    let figures = sheets.chain([("wheel on a rail".to_owned(), solution(&rail).unwrap())]);
    let (mut count, mut untold) = (0, Vec::new());
    for (name, figure) in figures {
        let plain = |text: &str| text.replace(['\u{a0}', '\u{2009}'], " ");
        let lines: Vec<String> = sentences(&figure).iter().map(|line| plain(line)).collect();
        for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
            for row in rows_of(table).iter().skip(1) {
                let cells: Vec<String> = row.iter().map(|text| plain(&characters(text))).collect();
                // A construction of its own is told with that, and the angle of an input is given. What is seen from a
                // point of the frame has the name of what is absolute.
                let symbol = cells[0].trim_end_matches(|c: char| c.is_ascii_digit());
                let symbol = symbol.strip_suffix('O').filter(|_| symbol.contains('_')).unwrap_or(&cells[0]);
                let value = cells.get(1).and_then(|cell| number(cell));
                // What is zero needs no number.
                if cells[0].contains(", ")
                    || symbol.starts_with('θ')
                    || value.is_none_or(|(value, ..)| value == 0.0)
                {
                    continue;
                }
                count += 1;
                let states = |line: &String| {
                    line.contains(&format!("{symbol} = "))
                        || line.contains(symbol) && line.contains(&cells[1])
                };
                if !lines.iter().any(states) {
                    untold.push(format!("{name}: {}", cells.join(" ")));
                }
            }
        }
    }
    assert!(count > 500, "{count}");
    assert!(untold.is_empty(), "{} of {count}: {untold:#?}", untold.len());
}

/// The letters and names of the captions of a figure.
fn captions(figure: &Figure) -> Vec<String> {
    let mut all = Vec::new();
    figure.root.walk(&mut |node| {
        if let Node::Text(text) = node
            && text.class == "caption"
        {
            all.push(characters(text));
        }
    });
    all
}

/// A step sheet shows every figure of the solution under its letter.
#[test]
fn a_step_sheet_shows_what_the_solution_shows() {
    let letter = |caption: &String| caption.split(')').next().unwrap().to_owned();
    let mut figures = 0;
    for kind in
        KINDS.iter().filter(|kind| ["press", "engine", "four-bar", "turning-moment"].contains(&kind.name))
    {
        let scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        let construction = &solved.solution.construction;
        let whole = captions(&sheet::solution(&scene, construction, Language::English));
        let steps: HashSet<String> = captions(&sheet::step_by_step(&scene, construction, Language::English))
            .iter()
            .map(letter)
            .collect();
        for caption in whole.iter().filter(|caption| caption.starts_with('(')) {
            figures += 1;
            assert!(steps.contains(&letter(caption)), "{}: {caption}", kind.name);
        }
    }
    assert!(figures > 20, "{figures}");
}

/// In a picture of the steps nothing has a name that is not drawn there: a point that will fall on another one, a vector
/// that will lie on another one, is named when a step finds it.
#[test]
fn a_step_sheet_names_what_is_drawn_already() {
    let told = |group: &Group, key: &str| {
        group.data.iter().find(|(name, _)| *name == key).map(|(_, value)| value.clone())
    };
    // Names, and the images and vectors that are drawn, of one picture of a polygon.
    let read = |picture: &Group| -> (Vec<String>, HashSet<String>) {
        let (mut names, mut drawn) = (Vec::new(), HashSet::new());
        for own in within(picture) {
            let of = told(own, "of").filter(|_| own.class.split(' ').any(|class| class == "name"));
            names.extend(of.iter().flat_map(|of| of.split(' ')).map(str::to_owned));
            drawn.extend(told(own, "point").or_else(|| told(own, "quantity")));
        }
        (names, drawn)
    };
    let (mut pictures, mut late, mut early) = (0, 0, Vec::new());
    let own = ["rolling-wheel", "whitworth", "rack-pinion", "rack-wheel", "rolling-rocker", "oblique-yoke"];
    let kinds = KINDS.iter().filter(|kind| own.contains(&kind.name));
    let kinds = kinds.map(|kind| (kind.name, linkgram::scene::read(kind.scene, kind.name).unwrap()));
    let examples = ["pairs/wheel-on-moving-plane", "pairs/planet-and-rod", "pairs/wheel-in-ring"];
    let examples = examples.map(|name| (name, common::example(name)));
    for (name, scene) in kinds.chain(examples) {
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        let figure = sheet::step_by_step(&scene, &solved.solution.construction, Language::English);
        for kind in ["velocity", "acceleration"] {
            let is = |group: &&Group| group.class.split(' ').take(2).eq([kind, "polygon"]);
            let all: Vec<_> = within(&figure.root).into_iter().filter(is).map(read).collect();
            let Some((_, finished)) = all.last() else { continue };
            for (i, (names, drawn)) in all.iter().enumerate() {
                pictures += 1;
                late += usize::from(i > 0 && names.len() > all[i - 1].0.len());
                // What lies outside the picture has its name at the border, and no ink.
                for own in names.iter().filter(|own| finished.contains(*own) && !drawn.contains(*own)) {
                    early.push(format!("{name}: {own} in picture {} of the {kind} diagram", i + 1));
                }
            }
        }
    }
    assert!(pictures > 30 && late > 10, "{pictures} pictures, {late} with further names");
    assert!(early.is_empty(), "{}: {early:#?}", early.len());
}

/// Figures that a scene wishes together are lettered in their order, whatever the sheet would call them.
#[test]
fn figures_wished_together_have_letters_in_their_order() {
    use linkgram::drawing::{Wish, figure};
    let kind = KINDS.iter().find(|kind| kind.name == "slider-crank").unwrap();
    let scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
    let figures =
        ["acceleration", "skeleton", "klein", "inflection(3)", "velocity"].map(str::to_owned).to_vec();
    let drawn = figure(&scene, &Wish { figures, ..Wish::default() }).unwrap();
    let letters: Vec<char> = captions(&drawn)
        .iter()
        .filter(|caption| caption.starts_with('('))
        .filter_map(|caption| caption.chars().nth(1))
        .collect();
    assert_eq!(letters, ['a', 'b', 'c', 'd', 'e']);
}

/// Klein's construction begins with the rate in radians where the scene states it in turns, and reckons with its own
/// readings as it prints them.
#[test]
fn klein_s_construction_begins_with_the_rate_in_radians() {
    let text = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0]},
        "links": {"2": {"joins": ["O2", "A"], "length": 50}, "3": {"joins": ["A", "B"], "length": 130}},
        "slides": [{"pin": "B", "block": 4, "on": {"link": 1, "through": [0, -15], "angle": 0}}],
        "near": {"B": [160, -15]},
        "input": {"link": 2, "angle": 55, "omega": "300 rpm ccw", "alpha": "500 rad/s^2 ccw"},
        "find": [{"name": "v(B/A)", "method": "klein"}, {"name": "omega(3)", "method": "klein"},
                 {"name": "alpha(3)", "method": "klein"}]}"#;
    let figure = solution(&linkgram::scene::read(text, "test").unwrap()).unwrap();
    let lines = sentences(&figure);
    let place = |begin: &str| lines.iter().position(|line| line.starts_with(begin)).unwrap();
    assert!(lines[place("ω_2")].contains("2π\u{a0}×\u{a0}300\u{a0}/\u{a0}60"));
    assert!(place("ω_2") < place("The crank"));
    let read = |of: &str| {
        let line = lines.iter().find(|line| line.starts_with(&format!("Read {of}"))).unwrap();
        printed(line.rsplit('=').next().unwrap()).unwrap().0
    };
    let used = |begin: &str| {
        let (_, _, numbers, _) = formula(&lines[place(begin)]).unwrap();
        numbers[0].clone()
    };
    assert_eq!(read("V_BA"), used("ω_3"));
    assert_eq!(read("A^t_BA"), used("α_3"));
}

/// The cells of a table row by row, from the left.
pub(crate) fn rows_of(table: &Group) -> Vec<Vec<&Text>> {
    let mut rows: Vec<Vec<&Text>> = Vec::new();
    for node in &table.children {
        let Node::Text(text) = node else { continue };
        match rows.last_mut() {
            Some(row) if text.runs[0].at.x > row[row.len() - 1].runs[0].at.x => row.push(text),
            _ => rows.push(vec![text]),
        }
    }
    rows
}

/// A result table prints what the steps have come to, in the figures of a result; that is the answer as it was read, and
/// where no line ends with it the answer itself, rounded once.
#[test]
fn a_table_prints_what_the_steps_come_to() {
    /// Units of the last figure: what the steps come to may miss the answer by one, and is rounded.
    const ROUNDED: f64 = 1.5;
    /// Half a unit in the fourth figure of a reading, in its square.
    const OF_READINGS: f64 = 1e-3;
    // Subscripts and superscripts as the characters that they are.
    let plain = |text: &str| -> String {
        let place = |c: char| "₀₁₂₃₄₅₆₇₈₉".chars().position(|own| own == c);
        let digit = |c: char| place(c).and_then(|at| char::from_digit(at as u32, 10));
        let letter = |c: char| match c {
            'ⁿ' => 'n',
            'ᵗ' => 't',
            other => digit(other).unwrap_or(other),
        };
        text.chars().filter(|c| !['^', '_'].contains(c)).map(letter).collect()
    };
    let (mut rows, mut derived, mut own, mut wrong) = (0, 0, 0, Vec::new());
    for (i, kind) in KINDS.iter().enumerate() {
        let mut scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
        scene.sheet.paper = (i % 3 == 1).then(|| "A3 landscape".to_owned());
        let Ok(solved) = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene)
        else {
            continue;
        };
        let construction = &solved.solution.construction;
        let figure = sheet::solution(&scene, construction, Language::English);
        // The symbol before the first sign of equality of a line, and the numbers after the others.
        let told: Vec<(String, Vec<f64>)> = sentences(&figure)
            .iter()
            .filter_map(|line| {
                let mut parts = line.split('=');
                let symbol = parts.next()?.split([' ', '\u{a0}']).rfind(|word| !word.is_empty())?;
                let numbers = parts.filter_map(number).map(|(value, ..)| value.abs()).collect();
                Some((plain(symbol), numbers))
            })
            .collect();
        for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
            for row in rows_of(table).iter().skip(1) {
                let symbol = plain(&characters(row[0]));
                let Some((shown, half, _)) = row.get(1).and_then(|cell| {
                    let (value, half, rest) = number(Box::leak(characters(cell).into_boxed_str()))?;
                    Some((value, half, rest))
                }) else {
                    continue;
                };
                let asked = scene.mechanism.asked.iter().zip(&construction.answers);
                let answer = asked
                    .filter(|(asked, _)| plain(&sheet::symbol(&scene, asked.quantity).plain) == symbol)
                    .find_map(|(asked, reading)| match reading.answer {
                        Answer::Scalar { value, .. } => Some(value.abs() / asked.unit.si),
                        Answer::Vector { value: [x, y], .. } => Some(libm::hypot(x, y) / asked.unit.si),
                        _ => None,
                    });
                let Some(answer) = answer.filter(|_| !characters(row[1]).starts_with('(')) else { continue };
                rows += 1;
                let lines = || told.iter().filter(|(own, numbers)| *own == symbol && !numbers.is_empty());
                let differs = |other: f64, room: f64| (shown.abs() - other).abs() > room * (1.0 + 1e-6);
                derived += lines().count().min(1);
                // What is not told from zero reads as zero, whatever its lines come to; so is a number its own where its lines
                // have come farther from it than readings of four figures, and their squares, explain.
                let numbers = || lines().flat_map(|(_, numbers)| numbers);
                // Three figures, four from a thousand on.
                let figures = if answer >= 1000.0 { 4.0 } else { 3.0 };
                let unit = libm::exp10(libm::floor(libm::log10(answer)) + 1.0 - figures);
                let readable = unit.max(OF_READINGS * answer);
                let near = numbers().any(|other| (other - answer).abs() <= readable);
                let unlike = shown != 0.0 && near && numbers().all(|other| differs(*other, half));
                own += usize::from(lines().next().is_some() && !near);
                let room = if near { (ROUNDED * unit).max(OF_READINGS * answer + half) } else { half };
                if unlike || differs(answer, room) {
                    wrong.push(format!("{}: {symbol} = {shown}, and it is {answer}", kind.name));
                }
            }
        }
    }
    assert!(rows > 300 && derived > 150, "{rows}, {derived} told by lines");
    // Steps that miss their own results are few.
    assert!(25 * own <= derived, "{own} of {derived} results are not what their steps come to");
    assert!(wrong.is_empty(), "{} of {rows}: {wrong:#?}", wrong.len());
}

/// In all three scripts: a line of text that ends with "=" leaves the reader waiting.
#[test]
fn no_line_of_a_sheet_ends_with_a_sign_of_equality() {
    let mut scenes: Vec<(String, Scene)> = Vec::new();
    for kind in KINDS {
        scenes.push((kind.name.to_owned(), linkgram::scene::read(kind.scene, kind.name).unwrap()));
    }
    for name in ["centres/four-bar", "centres/whitworth", "forces/s000-ch5-21", "forces/s000-ch5-1"] {
        scenes.push((name.to_owned(), common::example(name)));
    }
    let (mut lines, mut wrong) = (0, Vec::new());
    for (name, scene) in &scenes {
        let solved = linkgram::solve::solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene).unwrap();
        for language in [Language::English, Language::Arabic, Language::Persian] {
            let figure = sheet::solution(scene, &solved.solution.construction, language);
            for group in within(&figure.root).into_iter().filter(|group| has(group, "sentence")) {
                let texts = group.children.iter().filter_map(|node| match node {
                    Node::Text(text) if text.class != "mark" => Some(characters(text)),
                    _ => None,
                });
                let texts: Vec<String> = texts.collect();
                lines += usize::from(!texts.is_empty());
                if texts.last().is_some_and(|last| last.trim_end().ends_with('=')) {
                    wrong.push(format!("{name}, {language:?}: {}", texts.concat()));
                }
            }
        }
    }
    assert!(lines > 10_000, "{lines}");
    assert!(wrong.is_empty(), "{} of {lines}: {wrong:#?}", wrong.len());
}

/// Scenes whose figures reach further than their joints: a Geneva wheel, centres far away, trial points, a large wheel that
/// rolls on a moving link.
const FAR: [(&str, &str); 4] = [
    (
        "Geneva",
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O3": [100, 0]},
    "links": {"2": {"joins": ["O2", "P"], "length": 50}, "3": {"joins": ["O3"]}},
    "slides": [{"pin": "P", "on": {"link": 3, "through": "O3"}}],
    "input": {"link": 2, "angle": 20, "omega": "60 rpm ccw"}, "find": ["omega(3)", "alpha(3)"]}"#,
    ),
    (
        "far centres",
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [1000, 2000], "O4": [1600, 2010]},
    "links": {"2": {"joins": ["O2", "A"], "length": 80}, "3": {"joins": ["A", "B"], "length": 600},
              "4": {"joins": ["O4", "B"], "length": 85}},
    "near": {"B": [1640, 2080]}, "input": {"link": 2, "angle": 50, "omega": "5 rad/s ccw"},
    "find": ["v(B)", "a(B)", "omega(3)", "alpha(4)", "I(1,3)", "I(2,4)"]}"#,
    ),
    (
        "trials",
        r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 120]},
    "links": {"2": {"joins": ["O2", "A"]}, "3": {"joins": ["A", "B"]}, "4": {"joins": ["C", "B"]}},
    "rolls": [{"links": [1, 4], "line": {"link": 1, "through": [0, 0], "angle": 0}, "centre": "C", "radius": 75}],
    "near": {"C": [250, 75], "B": [230, 110]}, "input": {"link": 2, "omega": "6 rad/s ccw"},
    "find": ["v(B)", "v(C)", "omega(4)", "a(C)", "alpha(4)"],
    "where": {"B": [{"from": "A", "distance": 220}, {"from": "C", "distance": 40}],
              "A": [{"from": "O2", "distance": 60, "direction": 60}],
              "C": [{"from": "O2", "distance": 254}, {"on": {"link": 1, "through": [0, 75]}}]}}"#,
    ),
    ("driven rod", crate::told::DRIVEN_ROD),
];

/// No sheet is wider or higher than its paper, and nothing on it stands in its margins, whatever is drawn.
#[test]
fn nothing_stands_outside_of_the_paper() {
    use linkgram::drawing::{Kind, Wish, figure};
    /// The margin, less what letters lean and round.
    const MARGIN: f64 = 16.0;
    let kinds = KINDS.iter().map(|kind| (kind.name, kind.scene));
    let (mut sheets, mut wrong) = (0, Vec::new());
    for (name, text) in FAR.into_iter().chain(kinds) {
        let scene = linkgram::scene::read(text, name).unwrap();
        let (width, height) = sheet::paper(&scene);
        for kind in Kind::ALL {
            let Ok(own) = figure(&scene, &Wish { kind, ..Wish::default() }) else { continue };
            sheets += 1;
            let pages = own.pages().len().max(1) as f64;
            if own.width > width + 0.1 || own.height > pages * height + 0.1 {
                wrong.push(format!("{name} {kind:?}: {} by {} mm", own.width, own.height));
            }
            let ink = own.root.bounds().unwrap();
            if ink.x0 < MARGIN || ink.x1 > own.width - MARGIN {
                wrong.push(format!("{name} {kind:?}: ink from {} to {} mm", ink.x0, ink.x1));
            }
        }
    }
    assert!(sheets > 150, "{sheets}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// The parts of the steps of a sheet in their order: class, page and the height at which each begins.
fn strips_of(figure: &Figure) -> Vec<(&'static str, usize, f64)> {
    let pages: Vec<&Group> = within(&figure.root).into_iter().filter(|group| has(group, "page")).collect();
    let of_page = |(page, group): (usize, &&Group)| {
        let strips = group.children.iter().filter_map(|node| match node {
            Node::Group(own) => {
                let class = ["step-head", "sentence", "terms"].into_iter().find(|class| has(own, class))?;
                Some((class, page, own.bounds()?.y0))
            }
            _ => None,
        });
        strips.collect::<Vec<_>>()
    };
    pages.iter().enumerate().flat_map(of_page).collect()
}

/// A head does not stand over a single line at the end of a column, nor does the last line of a step stand alone on top of
/// the next.
#[test]
fn no_line_of_a_step_stands_alone() {
    let (mut alone, mut breaks) = (Vec::new(), 0);
    for (name, figure) in all() {
        let strips = strips_of(&figure);
        let class = |i: usize| strips.get(i).map(|strip| strip.0);
        for i in 1..strips.len() {
            let ((_, page, y), (_, next, below)) = (strips[i - 1], strips[i]);
            if page == next && below > y {
                continue;
            }
            breaks += 1;
            if class(i) == Some("step-head") {
                continue;
            }
            let head = i >= 2 && class(i - 1) == Some("sentence") && class(i - 2) == Some("step-head");
            let last = class(i) == Some("sentence") && matches!(class(i + 1), None | Some("step-head"));
            if head || last || class(i - 1) == Some("step-head") {
                alone.push(format!(
                    "{name}: pages {} and {}, part {i} of {}",
                    page + 1,
                    next + 1,
                    strips.len()
                ));
            }
        }
    }
    assert!(breaks > 200, "{breaks}");
    assert!(alone.is_empty(), "{} of {breaks}: {alone:#?}", alone.len());
}

fn drawn(text: &str, kind: linkgram::drawing::Kind) -> Figure {
    use linkgram::drawing::{Wish, figure};
    figure(&common::read(text), &Wish { kind, ..Wish::default() }).unwrap()
}

/// Drawings that are higher than wide stand side by side under captions of two lines, and steps are kept for the pages of
/// the last ones; in a step sheet pictures stand below their words in columns where half of the pages would be blank.
#[test]
fn pages_before_the_last_are_not_half_blank() {
    use linkgram::drawing::Kind;
    let lift = r#"{ "title": "Lift", "units": { "length": "cm" }, "fixed": { "O2": [0, 0] },
        "links": { "2": { "joins": ["O2", "A"], "length": 8 }, "3": { "joins": ["A", "B"], "length": 26 },
            "4": { "joins": ["B", "H"], "shape": { "B": [0, 0], "H": [5, -12] } } },
        "slides": [{ "link": 4, "on": { "link": 1, "through": [3, 0], "angle": 90 } }],
        "near": { "B": [3, 30] }, "gravity": {}, "masses": { "4": { "mass": 12, "at": "H" } },
        "input": { "link": 2, "angle": 20, "omega": "40 rpm ccw" }, "find": ["T(2)", "F(1,4)", "F(3,4)"] }"#;
    let rack = std::fs::read_to_string("examples/pairs/rack-on-moving-guide.json").unwrap();
    for (text, kind, most) in [(lift, Kind::Solution, 4), (&rack, Kind::Steps, 6)] {
        let figure = drawn(text, kind);
        let fills: Vec<f64> = pages(&figure).into_iter().map(|(fill, _)| fill).collect();
        assert!(fills.len() <= most, "{fills:?}");
        assert!(fills[..fills.len() - 1].iter().all(|fill| *fill > 0.6), "{fills:?}");
        let touching = overlaps(&figure);
        assert!(touching.is_empty(), "{touching:#?}");
    }
}

/// One arrow that has two names, as the wheel's axle seen from the frame and from the contact, is read once: to the same
/// hundredths.
#[test]
fn one_arrow_has_one_reading() {
    let kind = KINDS.iter().find(|kind| kind.name == "rack-wheel").unwrap();
    let figure = solution(&linkgram::scene::read(kind.scene, kind.name).unwrap()).unwrap();
    let readings: Vec<String> = sentences(&figure)
        .iter()
        .filter_map(|line| {
            let (before, after) = line.split_once(": ").filter(|(before, _)| before.starts_with("Read V"))?;
            let image = before.rsplit("= ").next()?;
            matches!(image, "ob" | "bp_4")
                .then(|| after.split('\u{a0}').next().unwrap_or_default().to_owned())
        })
        .collect();
    assert_eq!(readings.len(), 2, "{:#?}", sentences(&figure));
    assert_eq!(readings[0], readings[1]);
}

/// On the sleeve of Watt's governor nothing acts where it has no mass and nothing rubs: what joins it to the balls carries
/// no force, which the steps say, and nothing is said of loads given for both halves.
#[test]
fn a_sleeve_on_which_nothing_acts_is_told() {
    use linkgram::drawing::Kind;
    let governor = |masses: &str| {
        format!(
            r#"{{ "title": "Watt", "units": {{ "length": "mm" }}, "fixed": {{ "O": [0, 0] }},
            "placed": {{ "B": [160, -190], "S": [0, -380] }},
            "links": {{ "2": {{ "joins": ["O", "B"] }}, "3": {{ "joins": ["B", "S"] }} }},
            "slides": [{{ "pin": "S", "block": 4, "on": {{ "link": 1, "through": "O", "angle": 90 }} }}],
            "input": {{ "link": 2 }}, "gravity": {{}}, "masses": {{ "2": {{ "mass": 3, "at": "B" }}{masses} }},
            "spin": {{ "axis": {{ "through": [0, 0], "angle": 90 }}, "omega": "?", "balls": 2, "sleeve": 4 }},
            "find": ["spin", "Fc(2)"] }}"#
        )
    };
    for (masses, idle) in [("", true), (r#", "4": { "mass": 6, "at": "S" }"#, false)] {
        let figure = drawn(&governor(masses), Kind::Solution);
        let mut text = String::new();
        figure.root.walk(&mut |node| {
            if let Node::Text(own) = node {
                text += &own.content();
                text.push(' ');
            }
        });
        let text = text.replace('\u{a0}', " ");
        assert_eq!(text.contains("Nothing acts on the sleeve"), idle, "{text}");
        assert_eq!(text.contains("given for the whole"), !idle, "{text}");
    }
}

/// The question of a governor shows its axis of rotation; a spring on the frame hangs on the ground.
#[test]
fn a_governor_has_its_axis_and_a_spring_its_ground() {
    use linkgram::drawing::{Kind, Wish, figure};
    let drawn = |name: &str, kind: Kind| {
        let own = KINDS.iter().find(|own| own.name == name).unwrap();
        let scene = linkgram::scene::read(own.scene, name).unwrap();
        figure(&scene, &Wish { kind, ..Wish::default() }).unwrap()
    };
    for name in ["governor-porter", "governor-hartnell"] {
        let question = drawn(name, Kind::Question);
        assert!(within(&question.root).into_iter().any(|group| has(group, "axis")), "{name}");
    }
    let sheet = drawn("governor-hartnell", Kind::Solution);
    let hatched = |group: &&Group| {
        let own = within(group).into_iter().flat_map(marks);
        has(group, "spring") && own.filter(|mark| mark.class == "hatch").count() > 2
    };
    assert!(within(&sheet.root).iter().any(hatched));
}

/// A magnitude in a table of terms is that of the vector of this name in the diagram.
#[test]
fn a_table_of_terms_has_the_sizes_of_what_is_drawn() {
    let plain = |text: &str| text.chars().filter(|c| c.is_alphanumeric()).collect::<String>();
    let (mut terms, mut wrong) = (0, Vec::new());
    for (name, figure) in all() {
        let mut sizes: HashMap<String, f64> = HashMap::new();
        for diagram in within(&figure.root).into_iter().filter(|group| has(group, "polygon")) {
            let vectors: HashMap<&str, f64> = within(diagram)
                .into_iter()
                .filter(|group| has(group, "vector"))
                .filter_map(|group| Some((data(group, "quantity")?, data(group, "value")?.parse().ok()?)))
                .collect();
            for label in within(diagram).into_iter().filter(|group| has(group, "name")) {
                let Some(size) = data(label, "of").and_then(|of| vectors.get(of.split(' ').next()?)) else {
                    continue;
                };
                let texts = label.children.iter().filter_map(|node| match node {
                    Node::Text(text) => Some(characters(text)),
                    _ => None,
                });
                for text in texts {
                    sizes.extend(text.split('=').map(|symbol| (plain(symbol), *size)));
                }
            }
        }
        for table in within(&figure.root).into_iter().filter(|group| has(group, "terms")) {
            let rows = rows_of(table);
            let [head, magnitudes, ..] = &rows[..] else { continue };
            let symbols: Vec<String> =
                head.iter().map(|cell| plain(&characters(cell))).filter(|s| !s.is_empty()).collect();
            let numbers = &magnitudes[1..];
            if symbols.len() != numbers.len() {
                continue;
            }
            for (symbol, cell) in symbols.iter().zip(numbers) {
                let text = characters(cell);
                let Some((shown, ..)) = number(text.trim_start_matches(|c: char| !c.is_ascii_digit())) else {
                    continue;
                };
                let Some(size) = sizes.get(symbol) else { continue };
                terms += 1;
                // A reading has three figures.
                if (shown - size).abs() > 6e-3 * size {
                    wrong.push(format!("{name}: {symbol} is {shown} in the table and {size} in the diagram"));
                }
            }
        }
    }
    println!("{terms} terms");
    assert!(terms > 100, "{terms}");
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// A curved slot about a joint that is not found yet cannot be drawn; what a cylinder drives is how fast it grows; a gas force
/// is one number; lengths that are one on paper are read alike.
#[test]
fn what_cannot_be_drawn_is_not_told_and_what_is_given_has_its_own_name() {
    let told = |text: &str| {
        let figure = solution(&linkgram::scene::read(text, "test").unwrap()).unwrap();
        sentences(&figure)
    };
    let kind = |name: &str| KINDS.iter().find(|kind| kind.name == name).unwrap().scene;
    let lines = told(kind("curved-slot"));
    let position = lines.iter().position(|line| line.contains("radius BC")).unwrap();
    assert!(
        lines[position + 1].contains("O_3C") && lines[position + 1].ends_with("The lines meet in C."),
        "{lines:#?}"
    );
    assert!(!lines.iter().any(|line| line.starts_with("Draw the guide of B")), "{lines:#?}");

    let scene = linkgram::scene::read(CYLINDER, "test").unwrap();
    let question = sheet::question(
        &scene,
        &linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_scene)
            .unwrap()
            .solution
            .construction,
        Language::English,
    );
    let mut words = String::new();
    question.root.walk(&mut |node| {
        if let Node::Text(text) = node {
            words += &characters(text);
        }
    });
    assert!(words.contains("V_A_2A_3\u{a0}=\u{a0}60") || words.contains("V_A2A3\u{a0}=\u{a0}60"), "{words}");

    let lines = told(kind("engine"));
    let number_after = |begin: &str| {
        let line = lines.iter().find(|line| line.starts_with(begin)).unwrap();
        line.rsplit('=').next().and_then(printed).unwrap()
    };
    let (area, _) = number_after("A\u{a0}=");
    let load = lines.iter().find(|line| line.contains("p\u{a0}·\u{a0}A")).unwrap();
    let figures = area.to_string().replace('.', "");
    assert!(load.contains(&format!("0.00{figures}")), "{area}: {load}");
}

/// A cylinder between two levers' pins that grows at 60 mm/s.
const CYLINDER: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O4": [600, -100]},
    "links": {"2": {"joins": ["O2", "A", "L"], "line": [0, 700, 1500]}, "3": {"joins": ["O4", "K"], "length": 500}},
    "slides": [{"pin": "A", "block": 4, "on": {"link": 3, "through": "O4", "toward": "K"}}],
    "near": {"A": [500, 480]}, "input": {"slide": "A", "at": 580, "velocity": "60 mm/s"},
    "find": ["omega(2)", "omega(3)", "v(L)"]}"#;

/// A question has one page, and its figure is no smaller than the page makes it.
#[test]
fn a_question_fills_its_page() {
    for kind in KINDS {
        let scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
        let Ok(solved) = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_question)
        else {
            continue;
        };
        let figure = sheet::question(&scene, &solved.solution.construction, Language::English);
        assert!(figure.height <= 297.0 && figure.width <= 210.0, "{}: {} mm", kind.name, figure.height);
        if let "punch-press" | "peaucellier" | "parallel-crank" = kind.name {
            let skeleton = within(&figure.root).into_iter().find(|group| has(group, "skeleton")).unwrap();
            let ink = skeleton.bounds().unwrap();
            assert!(ink.width().max(ink.height()) > 120.0, "{}: {ink:?}", kind.name);
        }
    }
}

/// A step draws a guide by what stands already.
#[test]
fn a_guide_is_drawn_by_what_stands() {
    let lines = |scene: &Scene| sentences(&solution(scene).unwrap()).join(" ").replace('\u{a0}', " ");
    let kind = |name: &str| {
        let kind = KINDS.iter().find(|kind| kind.name == name).unwrap();
        linkgram::scene::read(kind.scene, kind.name).unwrap()
    };
    // A slot at 65° to the guide of a yoke that only translates: through the crank pin, which stands, and C is where it meets
    // the guide.
    let told = lines(&kind("oblique-yoke"));
    assert!(told.contains("Draw the guide of A through A at 65° to the horizontal."), "{told}");
    assert!(told.contains("The lines meet in C."), "{told}");
    // A slot 25 mm beside its pivot is a tangent.
    let told = lines(&kind("offset-shaper"));
    assert!(told.contains("About O_4 strike a circle with the radius 25 mm (10.0 mm)."), "{told}");
    assert!(told.contains("The tangent to it through A is the guide of A."), "{told}");
    // A trammel of 100 mm at -30° that is driven by its bar: A lies on the guide of B, shifted by the bar.
    let told = lines(&common::example("pairs/trammel-driven-by-bar"));
    assert!(
        told.contains("Shift it by BA = 100 mm (100.0 mm) at 150° to the horizontal: A lies on it."),
        "{told}"
    );
    // B at (30, 15) of a crosshead whose axis lies 5° off its guide: 30 sin 5° + 15 cos 5° beside it.
    let told = lines(&common::example("pairs/riding-link"));
    assert!(
        told.contains("Draw the parallel to it at the distance 17.6 mm (8.8 mm): B lies on it."),
        "{told}"
    );
    // An arc has its centre and its radius.
    let told = lines(&kind("eccentric-pump"));
    let scale = told.split("to the scale 1 : ").nth(1).and_then(|rest| rest.split(". ").next()).unwrap();
    let paper = 250.0 / scale.parse::<f64>().unwrap();
    let arc =
        format!("About E strike an arc with the radius R = 250 mm ({paper:.1} mm). It is the guide of D.");
    assert!(told.contains(&arc), "{told}");
    // The far end of a rod that runs on past a joint.
    let told = lines(&kind("six-link"));
    assert!(told.contains("Mark C on link 4: O_4C = 30 cm (30.0 mm), beyond O_4."), "{told}");
}

/// Four figures are what a hand reads and a table needs.
#[test]
fn nobody_reads_five_figures() {
    let figures = |text: &str| {
        let digits: String = text.chars().filter(char::is_ascii_digit).collect();
        let digits = digits.trim_start_matches('0');
        // Noughts of a whole number are places.
        if text.contains('.') { digits.len() } else { digits.trim_end_matches('0').len() }
    };
    let (mut read, mut long) = (0, Vec::new());
    for (name, figure) in all() {
        for sentence in sentences(&figure).iter().filter(|sentence| sentence.starts_with("Read ")) {
            let result = sentence.rsplit('=').next().unwrap();
            let (Some((text, _)), true) = (printed(result), sentence.contains('×')) else { continue };
            read += 1;
            if figures(text.split('×').next().unwrap()) > 4 {
                long.push(format!("{name}: {sentence}"));
            }
        }
        for table in within(&figure.root).into_iter().filter(|group| has(group, "results")) {
            for row in rows_of(table).iter().skip(1).filter(|row| row.len() > 1) {
                let cell = characters(row[1]);
                let Some((text, _)) = printed(&cell).filter(|_| !cell.starts_with('(')) else { continue };
                if figures(text.split('×').next().unwrap()) > 4 {
                    long.push(format!("{name}: {} {cell}", characters(row[0])));
                }
            }
        }
    }
    assert!(read > 500, "{read}");
    assert!(long.is_empty(), "{} of {read}: {long:#?}", long.len());
}

/// What a step reads from one image to another has an arrow there, with its name.
#[test]
fn a_velocity_that_is_read_is_drawn() {
    let mut read = 0;
    for kind in KINDS.iter().filter(|kind| ["coupler-point", "two-sliders", "v-engine"].contains(&kind.name))
    {
        let figure = solution(&linkgram::scene::read(kind.scene, kind.name).unwrap()).unwrap();
        let groups = within(&figure.root);
        let polygon = groups.iter().find(|group| has(group, "velocity") && has(group, "polygon")).unwrap();
        let drawn: Vec<&str> = within(polygon)
            .into_iter()
            .filter(|group| has(group, "vector"))
            .filter_map(|group| data(group, "quantity"))
            .collect();
        for sentence in sentences(&figure).iter().filter(|sentence| sentence.starts_with("Read V_")) {
            let name: String =
                sentence["Read V_".len()..].chars().take_while(char::is_ascii_alphabetic).collect();
            if let [point, base] = name.chars().collect::<Vec<_>>()[..] {
                read += 1;
                let own = format!("v({point}/{base})");
                assert!(drawn.contains(&own.as_str()), "{}: {own} of {drawn:?}", kind.name);
            }
        }
    }
    assert!(read >= 6, "{read}");
}

/// A picture of a step sheet shows a stroke, not the pole alone.
#[test]
fn no_picture_of_a_step_is_a_pole_alone() {
    let mut pictures = 0;
    for kind in KINDS.iter().filter(|kind| ["rolling-wheel", "six-link", "crank-shaper"].contains(&kind.name))
    {
        let scene = linkgram::scene::read(kind.scene, kind.name).unwrap();
        let solved = linkgram::solve::solve(&scene, Extent::WholeSkeleton, sheet::scale::for_steps).unwrap();
        let figure = sheet::step_by_step(&scene, &solved.solution.construction, Language::English);
        for polygon in within(&figure.root).into_iter().filter(|group| has(group, "polygon")) {
            pictures += 1;
            assert!(within(polygon).iter().any(|group| has(group, "vector")), "{}", kind.name);
        }
    }
    assert!(pictures >= 10, "{pictures}");
}
