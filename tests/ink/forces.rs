//! The ink of forces: from the finished SVG alone every force, every effort and every distance h comes back, and every
//! polygon of forces is closed.
//!
//! The truth is the independent solver's, which is asked for whatever a polygon shows; weights are M g.

use std::collections::BTreeMap;

use linkgram::mechanism::force::Heaviness;
use linkgram::mechanism::quantity::Answer;
use linkgram::scene::Scene;
use roxmltree::{Document, Node};

use super::reader::{Mm2, circle, data, has, having, last_number, minus, path, printed_ratio, text_of};
use super::{DIAGONAL, sheets};

/// Every scene of forces that has free bodies.
fn texts() -> Vec<(String, String)> {
    let folders = ["examples/forces", "tests/derived"].map(|folder| sheets::root().join(folder));
    let files = folders.iter().flat_map(|folder| std::fs::read_dir(folder).unwrap());
    let json =
        files.map(|entry| entry.unwrap().path()).filter(|path| path.extension().is_some_and(|e| e == "json"));
    let read = json.map(|path| {
        let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
        (name, std::fs::read_to_string(path).unwrap())
    });
    let mut all: Vec<_> = read.filter(|(_, text)| text.contains("\"links\": {")).collect();
    all.sort();
    all
}

/// Newtons per millimetre of `scale 25 N ≡ 1 cm`; none where the caption has no such scale.
fn newtons_per_mm(caption: &str) -> Option<f64> {
    let real = caption.strip_suffix(" ≡ 1 cm")?;
    let words: Vec<&str> = real.split_whitespace().collect();
    let (unit, words) = words.split_last()?;
    let unit = match *unit {
        "mN" => 1e-3,
        "N" => 1.0,
        "kN" => 1e3,
        "MN" => 1e6,
        "lbf" => 4.448_221_615_260_5,
        _ => return None,
    };
    Some(last_number(words) * unit / 10.0)
}

/// A vector of a polygon of forces; without ends it is a point.
struct Side {
    quantity: String,
    sum: bool,
    ends: Option<[Mm2; 2]>,
}

/// A polygon of forces as read off.
struct Sides {
    caption: String,
    scale: f64,
    all: Vec<Side>,
}

fn centre(circle: Node) -> Mm2 {
    let number = |name| -> f64 { circle.attribute(name).unwrap().parse().unwrap() };
    [number("cx"), -number("cy")]
}

fn part<'a>(of: Node<'a, 'a>, class: &str) -> Option<Node<'a, 'a>> {
    of.children().find(|n| has(*n, class))
}

fn shaft_and_tip(vector: Node) -> Option<[Mm2; 2]> {
    let (shaft, head) = (part(vector, "shaft")?, part(vector, "head")?);
    // A torque has an arc.
    (!shaft.attribute("d")?.contains('A')).then(|| [path(shaft)[0], path(head)[0]])
}

/// A panel with its caption.
fn panels<'a>(document: &'a Document<'a>) -> Vec<(Node<'a, 'a>, String)> {
    let all = having(document.root_element(), "panel");
    all.filter_map(|panel| Some((panel, text_of(part(panel, "caption")?)))).collect()
}

fn polygons(document: &Document) -> Vec<Sides> {
    let mut all = Vec::new();
    for (panel, caption) in panels(document) {
        let of_forces = |n: &Node| has(*n, "polygon") && has(*n, "force");
        for drawing in panel.children().filter(of_forces) {
            let scale = newtons_per_mm(&caption).unwrap_or_else(|| panic!("{caption} has a scale of forces"));
            let side = |vector: Node| Side {
                quantity: data(vector, "quantity").to_owned(),
                sum: has(vector, "sum"),
                ends: (vector.attribute("data-as-point") != Some("true"))
                    .then(|| shaft_and_tip(vector).expect("a side has a shaft and a head")),
            };
            all.push(Sides {
                caption: caption.clone(),
                scale,
                all: having(drawing, "vector").map(side).collect(),
            });
        }
    }
    all
}

/// What the independent solver says of forces, by name, with its bound; names that nobody may ask are left out.
struct Truth {
    vectors: BTreeMap<String, ([f64; 2], f64)>,
    scalars: BTreeMap<String, (f64, f64)>,
    /// Metres.
    unit_of_length: f64,
}

impl Truth {
    fn of(text: &str, names: &[String]) -> Self {
        let mut scene: serde_json::Value = serde_json::from_str(text).unwrap();
        scene.as_object_mut().unwrap().remove("published");
        let mut truth = Self { vectors: BTreeMap::new(), scalars: BTreeMap::new(), unit_of_length: 1.0 };
        let mut asking = |names: &[String]| -> Option<Scene> {
            scene["find"] = names.into();
            linkgram::scene::read(&scene.to_string(), "ink").ok()
        };
        let names: Vec<String> =
            names.iter().filter(|name| asking(std::slice::from_ref(name)).is_some()).cloned().collect();
        let Some(scene) = asking(&names) else { return truth };
        truth.unit_of_length = scene.units.length.si;
        let state = linkgram::solve::solve_analytically(&scene).unwrap();
        for asked in &scene.mechanism.asked {
            match state.answer(&asked.quantity) {
                Answer::Vector { value, bound } => {
                    _ = truth.vectors.insert(asked.name.clone(), (value, bound))
                }
                Answer::Scalar { value, bound } => {
                    _ = truth.scalars.insert(asked.name.clone(), (value, bound))
                }
                _ => {}
            }
        }
        let m = &scene.mechanism;
        let gravity = m.forces.gravity;
        let down = [libm::cos(gravity.direction.value), libm::sin(gravity.direction.value)];
        for (link, of) in m.links.iter().zip(0..) {
            let Some(mass) = m.forces.mass(linkgram::mechanism::LinkId(of)) else { continue };
            let weight = match mass.heaviness {
                Heaviness::Mass(mass) => mass.value * gravity.g.value,
                Heaviness::Weight(weight) => weight.value,
                Heaviness::None => continue,
            };
            if m.forces.spin.is_none() {
                let name = format!("W({})", link.number);
                truth.vectors.insert(name, (down.map(|c| c * weight), 1e-12 * weight));
            }
        }
        truth
    }
}

/// The size of a force as it was drawn, or the other way round, and the error of reading it.
fn drawn(polygons: &[Sides], quantity: &str) -> Option<[f64; 2]> {
    let reversed = quantity.strip_prefix("F(").and_then(|rest| rest.strip_suffix(')')).and_then(|rest| {
        let (by, on) = rest.split_once(',')?;
        Some(format!("F({on},{by})"))
    });
    polygons.iter().find_map(|polygon| {
        let named = |side: &&Side| side.quantity == quantity || Some(&side.quantity) == reversed.as_ref();
        let [from, to] = polygon.all.iter().find(named)?.ends?;
        let [x, y] = minus(to, from);
        Some([libm::hypot(x, y) * polygon.scale, DIAGONAL * polygon.scale])
    })
}

#[test]
fn every_force_polygon_is_closed_and_true() {
    let (mut closed, mut recovered, mut open, mut failures) = (0, 0, 0, Vec::new());
    for (name, text) in texts() {
        let (.., svg) = sheets::draw_text(&name, &text);
        let document = Document::parse(&svg).unwrap();
        let polygons = polygons(&document);
        let mut names: Vec<String> = polygons
            .iter()
            .flat_map(|polygon| polygon.all.iter().map(|side| side.quantity.clone()))
            .collect();
        names.sort();
        names.dedup();
        let truth = Truth::of(&text, &names);
        for polygon in &polygons {
            let (mut gap, mut slack, mut missing) = ([0.0; 2], 0.0, false);
            let found = polygon.all.iter().any(|side| !side.sum && side.ends.is_some());
            // The sum of all is against them; one of parts is left out.
            let all_together = polygon.caption.contains("frame") || polygon.caption.contains("Shaking");
            for side in &polygon.all {
                let known = truth.vectors.get(&side.quantity);
                let sign = match (side.sum, all_together) {
                    (false, _) => 1.0,
                    (true, true) => -1.0,
                    (true, false) => 0.0,
                };
                let along = side.ends.map(|[from, to]| minus(to, from));
                // What is shorter than a millimetre is a point: what it stands for is told beside.
                let (along, error) = match (along, known) {
                    (Some(along), _) => (along, DIAGONAL),
                    (None, Some((value, bound))) => (value.map(|c| c / polygon.scale), bound / polygon.scale),
                    (None, None) => {
                        missing = true;
                        continue;
                    }
                };
                if side.ends.is_none() && libm::hypot(along[0], along[1]) > 1.0 + error {
                    failures.push(format!("{name}: {}: {} is no point", polygon.caption, side.quantity));
                }
                gap = [gap[0] + sign * along[0], gap[1] + sign * along[1]];
                slack += sign.abs() * error;
                let (Some((value, bound)), true) = (known, side.ends.is_some()) else {
                    open += usize::from(known.is_none());
                    continue;
                };
                recovered += 1;
                let off =
                    libm::hypot(along[0] * polygon.scale - value[0], along[1] * polygon.scale - value[1]);
                if off > bound + DIAGONAL * polygon.scale {
                    failures
                        .push(format!("{name}: {}: {} is off by {off} N", polygon.caption, side.quantity));
                }
            }
            if !missing && found {
                closed += 1;
                let gap = libm::hypot(gap[0], gap[1]);
                if gap > slack {
                    failures.push(format!("{name}: {} is open by {gap} mm", polygon.caption));
                }
            }
        }
    }
    println!("{recovered} sides recovered, {open} that nobody may ask, {closed} polygons closed");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(closed > 80 && recovered > 350, "{closed} {recovered}");
}

#[test]
fn efforts_and_offsets_are_measured() {
    let (mut torques, mut offsets, mut failures) = (0, 0, Vec::new());
    for (name, text) in texts() {
        let (.., svg) = sheets::draw_text(&name, &text);
        let document = Document::parse(&svg).unwrap();
        let polygons = polygons(&document);
        let of_inertia = (2..20).map(|link| format!("h({link})"));
        let names: Vec<String> = of_inertia.chain((2..20).map(|link| format!("T({link})"))).collect();
        let truth = Truth::of(&text, &names);
        for (panel, caption) in panels(&document) {
            // h: from the mass centre to the line of the force of inertia.
            let skeleton = part(panel, "skeleton");
            let drawn_on_it = skeleton.and_then(|skeleton| Some((skeleton, part(skeleton, "forces")?)));
            for (skeleton, forces) in
                drawn_on_it.into_iter().filter(|_| caption.contains("Loads and inertia"))
            {
                let length = printed_ratio(&caption) / 1000.0;
                for (link, h, bound) in (2..20).filter_map(|link| {
                    let (h, bound) = truth.scalars.get(&format!("h({link})"))?;
                    Some((link, h, bound))
                }) {
                    let named = |n: &Node| n.attribute("data-quantity") == Some(&format!("Fin({link})"));
                    // A line that no paper holds: the force stands at the mass centre, and its couple beside it.
                    let couple = |n: Node| n.attribute("data-quantity") == Some(&format!("Tin({link})"));
                    if forces.children().any(couple) {
                        continue;
                    }
                    let at = format!("G{link}");
                    let centre = having(skeleton, "joint").find(|n| n.attribute("data-point") == Some(&at));
                    let line = forces.children().find(named).and_then(shaft_and_tip);
                    let (Some(centre), Some([from, to])) = (centre, line) else { continue };
                    let ([x, y], [ax, ay]) = (minus(to, from), minus(circle(centre), from));
                    let [size, cross] = [libm::hypot(x, y), x * ay - y * ax];
                    let read = (cross / size).abs();
                    offsets += 1;
                    // The arrow is so short against the distance that its last digits turn it by so much.
                    let error = 2.0 * DIAGONAL * (1.0 + libm::hypot(ax, ay) / size) + bound / length;
                    if (read - h.abs() / length).abs() > error {
                        failures.push(format!("{name}: h({link}) is {read} mm, not {}", h / length));
                    }
                }
            }
            // T: the moments of what acts about where the frame holds the link.
            let Some(body) = part(panel, "free-body") else { continue };
            let sought: Vec<Node> =
                body.children().filter(|n| has(*n, "torque") && has(*n, "sought")).collect();
            let other_torque = body.children().any(|n| has(n, "torque") && !has(n, "sought"));
            let [sought] = sought[..] else { continue };
            let Some((torque, bound)) = truth.scalars.get(data(sought, "quantity")) else { continue };
            let length = printed_ratio(&caption) / 1000.0;
            let held = |n: &Node| {
                let frame = n.attribute("data-quantity").is_some_and(|q| q.starts_with("F(1,"));
                has(*n, "force") && frame
            };
            let (Some(frame), false) = (body.children().find(held), other_torque) else { continue };
            let Some(near) = frame.descendants().find(|n| n.has_tag_name("path")).map(|n| path(n)[0]) else {
                continue;
            };
            // A wavy line is written to three decimals: it begins at the pin.
            let pins = body.descendants().filter(|n| n.has_tag_name("circle"));
            let pins = pins.filter_map(|n| n.parent()).map(|group| {
                let circles = group.children().filter(|n| n.has_tag_name("circle"));
                circles.map(centre).collect::<Vec<Mm2>>()
            });
            let begins = |at: &Mm2| libm::hypot(at[0] - near[0], at[1] - near[1]) < 1e-3;
            let Some(pivot) = pins.flatten().find(begins) else { continue };
            // An arm that no paper holds is told, and not drawn in its length.
            let unit = truth.unit_of_length;
            let is_short = |arm: Node| {
                let told: f64 = arm.attribute("data-value").map_or(0.0, |value| value.parse().unwrap());
                let ends = arm.children().find(|n| n.has_tag_name("path")).map(path);
                let [x, y] = ends.map_or([0.0; 2], |ends| minus(ends[1], ends[0]));
                libm::hypot(x, y) * length < 0.99 * told * unit
            };
            if body.children().any(|n| has(n, "arm") && is_short(n)) {
                continue;
            }
            let (mut sum, mut error, mut whole) = (0.0, *bound, true);
            for force in body.children().filter(|n| has(*n, "force") && !held(n)) {
                let size = drawn(&polygons, data(force, "quantity"));
                let (Some([from, to]), Some([size, misread])) = (shaft_and_tip(force), size) else {
                    whole = false;
                    continue;
                };
                let ([x, y], [ax, ay]) = (minus(to, from), minus(from, pivot));
                let [along, far] = [libm::hypot(x, y), libm::hypot(ax, ay)];
                sum += (ax * y - ay * x) / along * length * size;
                error += size * length * 2.0 * DIAGONAL * (1.0 + far / along) + far * length * misread;
            }
            if whole {
                torques += 1;
                if (sum + torque).abs() > error {
                    failures.push(format!("{name}: {caption}: T is {}, not {torque} within {error}", -sum));
                }
            }
        }
    }
    println!("{torques} torques and {offsets} offsets measured");
    assert!(failures.is_empty(), "{}", failures.join("\n"));
    assert!(torques > 5 && offsets > 5, "{torques} {offsets}");
}
