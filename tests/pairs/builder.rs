//! Random mechanisms, built from their pose: every group is depended on what already stands, at a place where it
//! is well conditioned; its dimensions are then measured and written into a scene with the pose as `near`, so
//! that both solvers must assemble it again from lengths, angles and offsets.

use std::f64::consts::PI;

use proptest::prelude::*;
use serde_json::{Map, Value, json};

pub(crate) type P2 = [f64; 2];

pub(crate) fn dir(angle: f64) -> P2 {
    [angle.cos(), angle.sin()]
}

pub(crate) fn left(v: P2) -> P2 {
    [-v[1], v[0]]
}

pub(crate) fn plus(a: P2, factor: f64, b: P2) -> P2 {
    [a[0] + factor * b[0], a[1] + factor * b[1]]
}

pub(crate) fn minus(a: P2, b: P2) -> P2 {
    plus(a, -1.0, b)
}

pub(crate) fn dot(a: P2, b: P2) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

pub(crate) fn size(a: P2) -> f64 {
    a[0].hypot(a[1])
}

fn angle_of(a: P2) -> f64 {
    a[1].atan2(a[0])
}

pub(crate) fn apart(a: P2, b: P2) -> f64 {
    size(minus(a, b))
}

/// How a group looks: numbers in [0, 1) that the builder turns into choices.
#[derive(Debug, Clone)]
struct Recipe {
    kind: u8,
    /// Which base, which guide link, shape of the guide.
    choice: [f64; 4],
    /// Lengths and angles.
    number: [f64; 8],
}

fn recipe() -> impl Strategy<Value = Recipe> {
    let part = || 0.0..1.0_f64;
    (0..KINDS, [part(), part(), part(), part()], prop::array::uniform8(part()))
        .prop_map(|(kind, choice, number)| Recipe { kind, choice, number })
}

/// How many kinds of groups [`Built::hang`] knows.
const KINDS: u8 = 20;

#[derive(Debug, Clone)]
pub(crate) struct Plan {
    crank: f64,
    omega: f64,
    alpha: f64,
    groups: Vec<Recipe>,
}

pub(crate) fn plan(groups: usize) -> impl Strategy<Value = Plan> {
    (
        -PI..PI,
        prop_oneof![-3.0..-0.5_f64, 0.5..3.0_f64],
        -4.0..4.0_f64,
        prop::collection::vec(recipe(), 1..=groups),
    )
        .prop_map(|(crank, omega, alpha, groups)| Plan { crank, omega, alpha, groups })
}

/// From a number in [0, 1) to one in a range.
fn between(low: f64, high: f64, part: f64) -> f64 {
    low + (high - low) * part
}

/// An angle away from zero and from a half turn, of either sign: what two construction lines need.
fn steep(part: f64) -> f64 {
    let (sign, part) = if part < 0.5 { (-1.0, 2.0 * part) } else { (1.0, 2.0 * part - 1.0) };
    sign * between(0.5, PI - 0.5, part)
}

/// An angle near zero or a half turn.
fn flat(part: f64) -> f64 {
    steep(part) - PI / 2.0
}

fn pick<T: Clone>(list: &[T], part: f64) -> Option<T> {
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss)]
    let index = (part * list.len() as f64) as usize;
    list.get(index).cloned()
}

#[derive(Debug, Clone)]
struct Body {
    number: u32,
    /// Where its own coordinates lie.
    origin: P2,
    angle: f64,
    points: Vec<String>,
}

#[derive(Debug, Clone)]
struct Joint {
    name: String,
    at: P2,
    links: Vec<u32>,
}

#[derive(Debug, Clone, Default)]
struct Built {
    bodies: Vec<Body>,
    joints: Vec<Joint>,
    fixed: Map<String, Value>,
    links: Map<String, Value>,
    slides: Vec<Value>,
    rolls: Vec<Value>,
    inputs: Vec<Value>,
    near: Map<String, Value>,
    placed: Map<String, Value>,
    rides: Vec<Ride>,
    contacts: Vec<Contact>,
}

impl Built {
    fn number(&self) -> u32 {
        let last = self.bodies.iter().map(|b| b.number).max().unwrap_or(1);
        last.max(u32::try_from(self.slides.len()).unwrap() + last) + 1
    }

    fn fix(&mut self, at: P2) -> String {
        let name = format!("O{}", self.fixed.len() + 2);
        self.fixed.insert(name.clone(), json!(at));
        self.bodies[0].points.push(name.clone());
        self.joints.push(Joint { name: name.clone(), at, links: vec![1] });
        name
    }

    /// A new moving joint's name.
    fn joint(&mut self, at: P2) -> String {
        let name = format!("J{}", self.joints.len());
        self.near.insert(name.clone(), json!(at));
        self.joints.push(Joint { name: name.clone(), at, links: Vec::new() });
        name
    }

    fn at(&self, name: &str) -> P2 {
        self.joints.iter().find(|j| j.name == name).unwrap().at
    }

    fn body(&self, number: u32) -> &Body {
        self.bodies.iter().find(|b| b.number == number).unwrap()
    }

    fn add(&mut self, number: u32, names: &[&str], angle: f64) {
        let origin = self.at(names[0]);
        for joint in self.joints.iter_mut().filter(|j| names.contains(&j.name.as_str())) {
            joint.links.push(number);
        }
        let points = names.iter().map(|n| (*n).to_owned()).collect();
        self.bodies.push(Body { number, origin, angle, points });
    }

    /// A link by its own coordinates, with x from the first joint along `angle`.
    fn shaped(&mut self, number: u32, names: &[&str], angle: f64) {
        self.add(number, names, angle);
        let own: Map<String, Value> =
            names.iter().map(|n| ((*n).to_owned(), json!(self.own(number, self.at(n))))).collect();
        self.links.insert(number.to_string(), json!({ "joins": names, "shape": own }));
    }

    fn bar(&mut self, number: u32, from: &str, to: &str) {
        let along = minus(self.at(to), self.at(from));
        self.add(number, &[from, to], angle_of(along));
        self.links.insert(number.to_string(), json!({ "joins": [from, to], "length": size(along) }));
    }

    /// A point in a link's own coordinates.
    fn own(&self, number: u32, at: P2) -> P2 {
        let body = self.body(number);
        let (from, x) = (minus(at, body.origin), dir(body.angle));
        [dot(from, x), dot(from, left(x))]
    }

    /// A guide of a link: through `at` in direction `angle`, straight or an arc, said in one of the ways in
    /// which a scene may say it.
    fn guide(&self, number: u32, at: P2, angle: f64, manner: f64, part: f64) -> (Value, bool) {
        let body = self.body(number);
        let turned = between(-1.0, 1.0, part);
        let normal = left(dir(angle));
        if manner < 0.3 {
            let radius = between(0.8, 3.0, part);
            let side = if manner < 0.15 { 1.0 } else { -1.0 };
            let centre = self.own(number, plus(at, side * radius, normal));
            return (json!({ "link": number, "centre": centre, "radius": radius }), true);
        }
        // A wheel that carried a guide through its only joint would swivel.
        let wheel = number != 1 && body.points.len() == 1;
        let named = |first: usize| body.points.get(first).filter(|_| !wheel).map(|n| (n.clone(), self.at(n)));
        let guide = match (named(0), named(1)) {
            // Through a joint and toward another, turned and shifted.
            (Some((from, start)), Some((to, end))) if manner < 0.5 && number != 1 => {
                let turned = angle - angle_of(minus(end, start));
                let offset = dot(minus(at, start), normal);
                json!({ "link": number, "through": from, "toward": to, "turned": turned, "offset": offset })
            }
            // Through a joint at an angle, shifted.
            (Some((from, start)), _) if manner < 0.7 => {
                let offset = dot(minus(at, start), normal);
                json!({ "link": number, "through": from, "angle": angle - body.angle, "offset": offset })
            }
            // Through own coordinates, turned and shifted.
            _ => {
                let offset = between(-0.4, 0.4, part);
                let through = plus(plus(at, -offset, normal), between(-1.0, 1.0, manner), dir(angle));
                let angle = angle - body.angle - turned;
                json!({ "link": number, "through": self.own(number, through), "angle": angle,
                        "turned": turned, "offset": offset })
            }
        };
        (guide, false)
    }

    fn straight(&self, number: u32, at: P2, angle: f64, manner: f64, part: f64) -> Value {
        self.guide(number, at, angle, between(0.3, 1.0, manner), part).0
    }

    fn slide_pin(&mut self, pin: &str, block: bool, on: (Value, bool)) {
        let number = u32::try_from(on.0["link"].as_u64().unwrap()).unwrap();
        self.rides.push((pin.to_owned(), number, on.1));
        self.slides.push(if block {
            let block = self.number() + 50;
            json!({ "pin": pin, "block": block, "on": on.0 })
        } else {
            json!({ "pin": pin, "on": on.0 })
        });
    }

    fn slide_link(&mut self, link: u32, first: &str, turned: f64, on: Value) {
        let number = u32::try_from(on["link"].as_u64().unwrap()).unwrap();
        self.rides.push((first.to_owned(), number, false));
        self.slides.push(json!({ "link": link, "turned": turned, "on": on }));
    }

    fn moving(&self) -> Vec<Joint> {
        self.joints.iter().filter(|j| !j.links.contains(&1)).cloned().collect()
    }

    /// Links that could carry a guide for something that depends on this joint.
    fn others(&self, joint: &Joint) -> Vec<u32> {
        self.bodies.iter().map(|b| b.number).filter(|n| !joint.links.contains(n)).collect()
    }

    /// Hangs one group on what stands; says whether it could.
    fn hang(&mut self, recipe: &Recipe) -> bool {
        let [c0, c1, c2, c3] = recipe.choice;
        let n = recipe.number;
        let Some(base) = pick(&self.moving(), c0) else { return false };
        let Some(carrier) = pick(&self.others(&base), c1) else { return false };
        let block = c3 < 0.5;
        let reach = plus(base.at, between(0.8, 2.0, n[0]), dir(between(-PI, PI, n[1])));
        let rod_angle = angle_of(minus(reach, base.at));
        let number = self.number();
        match recipe.kind {
            // RRR about a new fixed pivot, with a coupler point.
            0 => {
                let pivot = self.fix(plus(reach, between(0.8, 2.0, n[2]), dir(rod_angle + steep(n[3]))));
                let pin = self.joint(reach);
                let extra = self.joint(plus(reach, between(0.3, 1.0, n[4]), dir(between(-PI, PI, n[5]))));
                self.shaped(number, &[&base.name, &pin, &extra], rod_angle);
                self.bar(number + 1, &pivot, &pin);
            }
            // RRP: a rod's pin on a guide of any link.
            1 => {
                let guide = self.guide(carrier, reach, rod_angle + flat(n[2]), c2, n[3]);
                let pin = self.joint(reach);
                let extra = self.joint(plus(reach, between(0.3, 1.0, n[4]), dir(between(-PI, PI, n[5]))));
                self.shaped(number, &[&base.name, &pin, &extra], rod_angle);
                self.slide_pin(&pin, block, guide);
            }
            // RPR: a lever about a joint, with a slot for a pin.
            2 | 3 => {
                let levers: Vec<Joint> = self
                    .joints
                    .iter()
                    .filter(|j| j.links.iter().all(|l| !base.links.contains(l)))
                    .filter(|j| (0.5..3.0).contains(&apart(j.at, base.at)))
                    .cloned()
                    .collect();
                let pivot = match pick(&levers, n[6]) {
                    Some(joint) if n[7] < 0.5 => joint.name,
                    _ => self.fix(reach),
                };
                let at = self.at(&pivot);
                let along = angle_of(minus(base.at, at)) + flat(n[2]);
                let lever_angle = between(-PI, PI, n[3]);
                let end = self.joint(plus(at, between(0.5, 1.5, n[4]), dir(lever_angle)));
                self.bar(number, &pivot, &end);
                if recipe.kind == 2 {
                    let guide = self.guide(number, base.at, along, c2, n[5]);
                    self.slide_pin(&base.name, block, guide);
                } else {
                    // A rod on the pin slides in the lever without turning against it.
                    let turned = between(-PI, PI, n[5]);
                    let tip = self.joint(plus(base.at, 0.7, dir(along + turned)));
                    self.bar(number + 1, &base.name, &tip);
                    let guide = self.straight(number, base.at, along, c2, n[7]);
                    self.slide_link(number + 1, &base.name, turned, guide);
                }
            }
            // PRP: a new pin on guides of two links.
            4 => {
                let carriers: Vec<u32> =
                    self.bodies.iter().map(|b| b.number).filter(|&m| m != carrier).collect();
                let Some(second) = pick(&carriers, c3) else { return false };
                let angle = between(-PI, PI, n[2]);
                let guides = [
                    self.guide(carrier, reach, angle, c2, n[3]),
                    self.guide(second, reach, angle + steep(n[4]), n[7], n[5]),
                ];
                let pin = self.joint(reach);
                let [first, second] = guides;
                self.slide_pin(&pin, true, first);
                self.slide_pin(&pin, n[6] < 0.5, second);
            }
            // Yoke: a link that slides on any link and carries a slot for a pin.
            5 | 6 => {
                let along = between(-PI, PI, n[2]);
                let turned = between(-PI, PI, n[3]);
                let ride = self.straight(carrier, reach, along, c2, n[4]);
                let first = self.joint(reach);
                let extra = self.joint(plus(reach, 0.6, dir(between(-PI, PI, n[5]))));
                self.shaped(number, &[&first, &extra], along + turned);
                self.slide_link(number, &first, turned, ride);
                let slot = self.straight(number, base.at, along + steep(n[6]), n[7], n[1]);
                self.slide_pin(&base.name, block, (slot, false));
            }
            // The yoke with a curved slot, or on whose guide the other link rides.
            7 => {
                let along = between(-PI, PI, n[2]);
                let first = self.joint(reach);
                let extra = self.joint(plus(reach, 0.6, dir(between(-PI, PI, n[5]))));
                self.shaped(number, &[&first, &extra], along + between(-PI, PI, n[3]));
                self.ride(carrier, number, &first, along, [c2, n[4]]);
                let slot = self.guide(number, base.at, along + steep(n[6]), n[7] * 0.9, n[1]);
                self.slide_pin(&base.name, block, slot);
            }
            // RRP whose pin is carried by a link that slides without turning.
            8 => {
                let along = rod_angle + flat(n[2]);
                let pin = self.joint(reach);
                let first = self.joint(plus(reach, between(0.2, 0.8, n[3]), dir(between(-PI, PI, n[4]))));
                self.bar(number, &base.name, &pin);
                self.shaped(number + 1, &[&first, &pin], between(-PI, PI, n[5]));
                self.ride(carrier, number + 1, &first, along, [c2, n[6]]);
            }
            // PRP whose pin is carried by one or two such links.
            9 => {
                let carriers: Vec<u32> =
                    self.bodies.iter().map(|b| b.number).filter(|&m| m != carrier).collect();
                let Some(second) = pick(&carriers, c3) else { return false };
                let along = between(-PI, PI, n[2]);
                let pin = self.joint(reach);
                let first = self.joint(plus(reach, 0.5, dir(between(-PI, PI, n[3]))));
                self.shaped(number, &[&first, &pin], between(-PI, PI, n[4]));
                if n[6] < 0.5 {
                    let guide = self.guide(second, reach, along + steep(n[5]), n[7], n[1]);
                    self.slide_pin(&pin, block, guide);
                } else {
                    let other = self.joint(plus(reach, 0.4, dir(between(-PI, PI, n[7]))));
                    self.shaped(number + 1, &[&other, &pin], between(-PI, PI, n[0]));
                    self.ride(second, number + 1, &other, along + steep(n[5]), [n[1], n[7]]);
                }
                self.ride(carrier, number, &first, along, [c2, n[1]]);
            }
            // RPP: a link that slides on a solved one, and a pinned link that slides on the first.
            10 => {
                let along = between(-PI, PI, n[2]);
                let first = self.joint(reach);
                let extra = self.joint(plus(reach, 0.6, dir(between(-PI, PI, n[3]))));
                let end = self.joint(plus(base.at, 0.7, dir(between(-PI, PI, n[4]))));
                self.shaped(number, &[&first, &extra], between(-PI, PI, n[5]));
                self.shaped(number + 1, &[&base.name, &end], between(-PI, PI, n[6]));
                self.ride(carrier, number, &first, along, [c2, n[7]]);
                let slot = along + steep(n[1]);
                if c3 < 0.5 {
                    let turned = self.body(number).angle - slot;
                    let guide = self.straight(number + 1, reach, slot, n[0], n[4]);
                    self.slide_link(number, &first, turned, guide);
                } else {
                    let turned = self.body(number + 1).angle - slot;
                    let guide = self.straight(number, base.at, slot, n[0], n[4]);
                    self.slide_link(number + 1, &base.name, turned, guide);
                }
            }
            // A wheel whose centre stands in one link with a point of the body on which it rolls.
            11 => return self.mesh(n, c1, number),
            // A wheel on a line: its centre rides on a parallel to it.
            12 => {
                let along = rod_angle + flat(n[2]);
                let centre = self.joint(reach);
                self.bar(number, &base.name, &centre);
                let guide = self.straight(carrier, reach, along, c2, n[3]);
                self.slide_pin(&centre, block, (guide, false));
                self.wheel(number + 1, &centre);
                self.roll_on_line(number + 1, &centre, carrier, along, n[4]);
            }
            // A rod with a wheel that only its contact holds.
            13 => {
                let centre = self.joint(reach);
                if n[5] < 0.5 {
                    self.bar(number, &base.name, &centre);
                    self.wheel(number + 1, &centre);
                    self.roll_on_line(number + 1, &centre, carrier, rod_angle + flat(n[2]), n[4]);
                } else {
                    let points = self.body(carrier).points.clone();
                    let Some(about) = pick(&points, n[6]) else { return false };
                    let arm = minus(reach, self.at(&about));
                    let crossing = (angle_of(arm) - rod_angle).sin().abs();
                    if crossing < 0.4 || size(arm) < 0.4 {
                        self.joints.pop();
                        self.near.remove(&centre);
                        return false;
                    }
                    self.bar(number, &base.name, &centre);
                    self.wheel(number + 1, &centre);
                    self.roll_on_circle(number + 1, &centre, carrier, &about, n[7]);
                }
            }
            // A rack on a guide of the frame, driven by any link about a fixed pivot.
            14 => {
                let pivots: Vec<Joint> = self
                    .joints
                    .iter()
                    .filter(|j| j.links.contains(&1) && j.links.len() > 1)
                    .cloned()
                    .collect();
                let Some(pivot) = pick(&pivots, c1) else { return false };
                let Some(&wheel) = pivot.links.iter().find(|l| **l != 1) else { return false };
                let along = between(-PI, PI, n[2]);
                let radius = between(0.2, 0.8, n[3]);
                let foot = plus(pivot.at, radius, left(dir(along)));
                let first = self.joint(plus(foot, between(-1.0, 1.0, n[4]), dir(along)));
                let extra = self.joint(plus(foot, 1.3, dir(between(-PI, PI, n[5]))));
                for name in [&first, &extra] {
                    let at = self.near.remove(name).unwrap();
                    self.placed.insert(name.clone(), at);
                }
                // Its own axes are the world's.
                self.add(number, &[&first, &extra], 0.0);
                self.bodies.last_mut().unwrap().origin = [0.0, 0.0];
                self.links.insert(number.to_string(), json!({ "joins": [first, extra] }));
                let guide = json!({ "link": 1, "through": self.at(&first), "angle": along });
                self.rides.push((first.clone(), 1, false));
                self.slides.push(json!({ "link": number, "on": guide }));
                let line = json!({ "link": number, "through": first, "angle": along });
                self.rolls.push(json!({ "links": [number, wheel], "line": line, "centre": pivot.name,
                                        "radius": radius }));
                self.contacts.push(Contact { bodies: [wheel, number], at: foot, normal: left(dir(along)) });
            }
            // A driven wheel on the frame whose centre nothing pins.
            15 => {
                let along = between(-PI, PI, n[2]);
                let radius = between(0.3, 1.0, n[3]);
                let [centre, rim] =
                    [reach, plus(reach, 0.8 * radius, dir(between(-PI, PI, n[4])))].map(|at| {
                        let name = self.joint(at);
                        let at = self.near.remove(&name).unwrap();
                        self.placed.insert(name.clone(), at);
                        name
                    });
                self.add(number, &[&centre, &rim], 0.0);
                self.bodies.last_mut().unwrap().origin = [0.0, 0.0];
                self.links.insert(number.to_string(), json!({ "joins": [centre, rim] }));
                self.roll_at(number, &centre, 1, along, radius);
                self.drive(json!({ "link": number, "omega": between(-3.0, 3.0, n[5]), "alpha": n[6] }));
            }
            // A second driven crank.
            16 => {
                let pivot = self.fix(reach);
                let angle = between(-PI, PI, n[2]);
                let pin = self.joint(plus(reach, between(0.5, 1.5, n[3]), dir(angle)));
                self.bar(number, &pivot, &pin);
                self.drive(json!({ "link": number, "angle": angle, "omega": between(-3.0, 3.0, n[4]),
                                   "alpha": between(-3.0, 3.0, n[5]) }));
            }
            // A driven slide: a pin, or a link that slides without turning.
            17 => {
                let along = between(-PI, PI, n[2]);
                let start = plus(reach, -between(0.5, 2.0, n[3]), dir(along));
                let on = json!({ "link": carrier, "through": self.own(carrier, start),
                                 "angle": along - self.body(carrier).angle });
                let rider = if n[4] < 0.5 {
                    let pin = self.joint(reach);
                    let block = number + 500;
                    self.rides.push((pin.clone(), carrier, false));
                    self.slides.push(json!({ "pin": pin, "block": block, "on": on }));
                    // A pin must stand in a link: it pushes a rod whose end rides on the frame.
                    let end = self.joint(plus(reach, 1.2, dir(along + n[5])));
                    self.bar(number, &pin, &end);
                    let guide = self.guide(1, self.at(&end), along + n[5] + flat(n[1]), c2, n[0]);
                    self.slide_pin(&end, block.is_multiple_of(2), guide);
                    json!(block)
                } else {
                    let turned = between(-PI, PI, n[5]);
                    let first = self.joint(reach);
                    let extra = self.joint(plus(reach, 0.8, dir(along + turned)));
                    self.shaped(number, &[&first, &extra], along + turned);
                    self.slide_link(number, &first, turned, on);
                    json!(number)
                };
                self.drive(json!({ "slide": rider, "at": apart(start, reach),
                                   "velocity": between(-2.0, 2.0, n[6]), "acceleration": between(-2.0, 2.0, n[7]) }));
            }
            // A driven link with two pins on guides.
            18 => {
                let along = between(-PI, PI, n[2]);
                let [first, second] = [reach, plus(reach, 1.1, dir(along))].map(|at| self.joint(at));
                let extra = self.joint(plus(reach, 0.7, dir(along + 0.8)));
                self.shaped(number, &[&first, &second, &extra], along);
                let direction = between(-PI, PI, n[3]);
                let guides = [
                    self.guide(carrier, reach, direction, c2, n[4]),
                    self.guide(1, self.at(&second), direction + steep(n[5]), n[6], n[7]),
                ];
                let [one, other] = guides;
                self.slide_pin(&first, block, one);
                self.slide_pin(&second, n[0] < 0.5, other);
                self.drive(json!({ "link": number, "angle": along, "omega": between(-3.0, 3.0, n[0]),
                                   "alpha": between(-3.0, 3.0, n[1]) }));
            }
            // A triad: a ternary link on three rods, two of them about fixed pivots.
            _ => {
                let corner = |turn: f64, far: f64| plus(reach, far, dir(rod_angle + turn));
                let places = [reach, corner(0.9, 1.1), corner(-0.5, 0.9)];
                let [first, second, third] = places.map(|at| self.joint(at));
                self.bar(number, &base.name, &first);
                self.shaped(number + 1, &[&first, &second, &third], rod_angle);
                for (index, (end, turn)) in
                    [(&second, between(0.6, 1.6, n[2])), (&third, between(-2.6, -1.6, n[3]))]
                        .into_iter()
                        .enumerate()
                {
                    let far = between(0.8, 1.8, n[4 + index]);
                    let pivot = self.fix(plus(self.at(end), far, dir(rod_angle + turn)));
                    self.bar(number + 2 + u32::try_from(index).unwrap(), &pivot, end);
                }
            }
        }
        true
    }

    fn drive(&mut self, input: Value) {
        self.inputs.push(input);
    }

    /// A link slides without turning against a solved one: on its guide, or carrying the guide on which
    /// that one rides.
    fn ride(&mut self, carrier: u32, link: u32, first: &str, along: f64, [manner, part]: [f64; 2]) {
        let solved = self.body(carrier).clone();
        // A link of placed points rides as placed, and an input names its pair by the only one of its link.
        let rides = carrier != 1
            && solved.points.len() > 1
            && !self.placed.contains_key(&solved.points[0])
            && self.inputs.iter().all(|input| input["slide"] != json!(carrier));
        if part < 0.5 || !rides {
            let turned = self.body(link).angle - along;
            let guide = self.straight(carrier, self.at(first), along, manner, part);
            self.slide_link(link, first, turned, guide);
        } else {
            let rider = solved.points[0].clone();
            let guide = self.straight(link, self.at(&rider), along, manner, part);
            self.slide_link(carrier, &rider, solved.angle - along, guide);
        }
    }

    fn wheel(&mut self, number: u32, centre: &str) {
        self.add(number, &[centre], 0.0);
        self.links.insert(number.to_string(), json!({ "joins": [centre] }));
    }

    fn roll_on_line(&mut self, wheel: u32, centre: &str, body: u32, along: f64, part: f64) {
        let side = if part < 0.5 { 1.0 } else { -1.0 };
        self.roll_at(wheel, centre, body, along, side * between(0.2, 0.7, (2.0 * part).fract()));
    }

    /// A wheel on a line that lies to the left of its centre for a positive radius.
    fn roll_at(&mut self, wheel: u32, centre: &str, body: u32, along: f64, radius: f64) {
        let normal = left(dir(along));
        let at = plus(self.at(centre), radius, normal);
        let line =
            json!({ "link": body, "through": self.own(body, at), "angle": along - self.body(body).angle });
        self.rolls
            .push(json!({ "links": [body, wheel], "line": line, "centre": centre, "radius": radius.abs() }));
        self.contacts.push(Contact { bodies: [wheel, body], at, normal });
    }

    /// A wheel on a circle of a body about one of its points: outside, in a ring, or as the ring.
    fn roll_on_circle(&mut self, wheel: u32, centre: &str, body: u32, about: &str, part: f64) {
        let arm = minus(self.at(centre), self.at(about));
        let (d, normal) = (size(arm), dir(angle_of(arm)));
        let inner = between(0.2, 0.7, (3.0 * part).fract()) * d;
        // Radii of the body's circle and of the wheel.
        let (radii, internal) = match part {
            p if p < 1.0 / 3.0 => ([d - inner, inner], false),
            p if p < 2.0 / 3.0 => ([d + inner, inner], true),
            _ => ([inner, d + inner], true),
        };
        let outward = if internal && radii[1] > radii[0] { -radii[0] } else { radii[0] };
        let at = plus(self.at(about), outward, normal);
        self.rolls.push(json!({ "links": [body, wheel], "centres": [about, centre], "radii": radii,
                                "internal": internal }));
        self.contacts.push(Contact { bodies: [wheel, body], at, normal });
    }

    /// A wheel on a joint of a link, rolling on another body about another joint of that link.
    fn mesh(&mut self, n: [f64; 8], part: f64, number: u32) -> bool {
        let mut places: Vec<(String, String, u32)> = Vec::new();
        for arm in &self.bodies {
            for centre in &arm.points {
                for about in arm.points.iter().filter(|p| *p != centre) {
                    let joint = self.joints.iter().find(|j| j.name == *about).unwrap();
                    for &body in joint.links.iter().filter(|l| **l != arm.number) {
                        let far = apart(self.at(centre), self.at(about));
                        if far > 0.3 && !self.body(body).points.contains(centre) {
                            places.push((centre.clone(), about.clone(), body));
                        }
                    }
                }
            }
        }
        let Some((centre, about, body)) = pick(&places, part) else { return false };
        self.wheel(number, &centre);
        self.roll_on_circle(number, &centre, body, &about, n[0]);
        true
    }
}

/// Where two bodies touch and the direction square to both.
#[derive(Debug, Clone)]
pub(crate) struct Contact {
    pub(crate) bodies: [u32; 2],
    pub(crate) at: P2,
    pub(crate) normal: P2,
}

/// A mechanism as a scene, and what laws hold of it.
#[derive(Debug, Clone)]
pub(crate) struct Made {
    pub(crate) scene: Value,
    pub(crate) rides: Vec<Ride>,
    pub(crate) contacts: Vec<Contact>,
    /// A joint of each body, and its place.
    pub(crate) holds: Vec<(u32, String, P2)>,
}

/// Riding joint and guide link of a sliding pair, and whether the guide is an arc.
pub(crate) type Ride = (String, u32, bool);

pub(crate) fn build(plan: &Plan) -> Option<Made> {
    let mut built = Built::default();
    built.bodies.push(Body { number: 1, origin: [0.0, 0.0], angle: 0.0, points: Vec::new() });
    let pivot = built.fix([0.0, 0.0]);
    let pin = built.joint(dir(plan.crank));
    let extra = built.joint(plus([0.0, 0.0], 0.8, dir(plan.crank + 1.1)));
    built.shaped(2, &[&pivot, &pin, &extra], plan.crank);
    built.drive(json!({ "link": 2, "angle": plan.crank, "omega": plan.omega, "alpha": plan.alpha }));
    let mut hung = 0;
    for recipe in &plan.groups {
        hung += usize::from(built.hang(recipe));
    }
    if hung == 0 {
        return None;
    }
    let mut find: Vec<String> = Vec::new();
    for joint in built.moving() {
        find.extend([
            format!("x({})", joint.name),
            format!("v({})", joint.name),
            format!("a({})", joint.name),
        ]);
    }
    for body in &built.bodies[1..] {
        find.extend([format!("omega({})", body.number), format!("alpha({})", body.number)]);
    }
    // A link that rides by a fixed pivot stands still there.
    built.rides.retain(|(pin, ..)| !built.fixed.contains_key(pin));
    for (pin, link, arc) in &built.rides {
        let names: &[&str] = if *arc {
            &["slip", "aslip", "coriolis", "aslipn", "aslipt"]
        } else {
            &["slip", "aslip", "coriolis"]
        };
        find.extend(names.iter().map(|name| format!("{name}({pin}/{link})")));
        find.extend(["v", "a"].map(|name| format!("{name}({pin}@{link})")));
    }
    find.dedup();
    let scene = json!({
        "units": { "angle": "rad" },
        "fixed": built.fixed,
        "links": built.links,
        "slides": built.slides,
        "rolls": built.rolls,
        "placed": built.placed,
        "near": built.near,
        "inputs": built.inputs,
        "find": find,
    });
    let hold = |b: &Body| b.points.first().map(|name| (b.number, name.clone(), built.at(name)));
    let holds = built.bodies.iter().filter_map(hold).collect();
    Some(Made { scene, rides: built.rides, contacts: built.contacts, holds })
}
