//! Random chains of a crank and dyads, assembled by construction: their places are known before any solver
//! runs, by this file's own geometry.

use std::f64::consts::TAU;

use proptest::prelude::*;
use proptest::sample::Index;
use serde_json::{Map, Value, json};

use super::{cross, dot, minus, norm, plus};

type Xy = [f64; 2];

fn polar(angle: f64, length: f64) -> Xy {
    let (sin, cos) = libm::sincos(angle);
    [length * cos, length * sin]
}

fn scaled(a: Xy, by: f64) -> Xy {
    [a[0] * by, a[1] * by]
}

fn left(a: Xy) -> Xy {
    [-a[1], a[0]]
}

fn unit(a: Xy) -> Xy {
    scaled(a, 1.0 / norm(a))
}

/// How a link's dimensions are written.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Writing {
    Length,
    Line,
    Sides,
    Arms,
    Shape,
}

/// A link: its way of writing, and where its third point lies (parts of its length, along and across).
#[derive(Debug, Clone, Copy)]
struct LinkSpec {
    writing: Writing,
    third: Xy,
    /// One of the six orders of three joints, or the two of two.
    order: usize,
}

/// How a guide is written.
#[derive(Debug, Clone, Copy)]
enum GuideWriting {
    Through,
    Offset,
    Toward,
    Turned,
}

/// A group of two links, or of a rod and a block.
#[derive(Debug, Clone)]
enum DyadSpec {
    Rrr { base: Index, other: Index, fixed: bool, at: Xy, links: [LinkSpec; 2] },
    Rrp { base: Index, away: Xy, tilt: f64, writing: GuideWriting, block: bool, link: LinkSpec },
}

/// A crank.
#[derive(Debug, Clone)]
struct CrankSpec {
    length: f64,
    degrees: f64,
    omega: f64,
    alpha: f64,
    link: LinkSpec,
}

/// A moving link and its points' names.
#[derive(Debug, Clone)]
pub(crate) struct ChainLink {
    pub(crate) number: u32,
    pub(crate) joins: Vec<String>,
}

/// A chain as a scene file, and what its maker knows of it.
#[derive(Clone)]
pub(crate) struct Chain {
    /// The scene.
    pub(crate) text: String,
    /// Place of every point, in metres.
    pub(crate) places: Vec<(String, Xy)>,
    /// Links that are not blocks.
    pub(crate) links: Vec<ChainLink>,
    /// Direction of the guide of each sliding pair.
    pub(crate) guides: Vec<Xy>,
    /// Number of links with the frame and the blocks.
    pub(crate) count: usize,
    /// Two points of one link carry a dyad: it cannot move against that link.
    pub(crate) stiff: bool,
}

impl std::fmt::Debug for Chain {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.text)
    }
}

impl Chain {
    pub(crate) fn place(&self, name: &str) -> Xy {
        self.places.iter().find(|(n, _)| n == name).unwrap().1
    }
}

fn link_spec() -> impl Strategy<Value = LinkSpec> {
    let writing = prop_oneof![
        3 => Just(Writing::Length),
        2 => Just(Writing::Line),
        2 => Just(Writing::Sides),
        2 => Just(Writing::Arms),
        2 => Just(Writing::Shape),
    ];
    // Three points of a link never lie close together, nor on a line unless they must.
    let along = prop_oneof![-0.6..-0.15_f64, 0.15..0.85_f64, 1.15..1.6_f64];
    let across = prop_oneof![0.15..1.0_f64, -1.0..-0.15_f64];
    (writing, along, across, 0..6_usize).prop_map(|(writing, along, across, order)| LinkSpec {
        writing,
        third: [along, across],
        order,
    })
}

/// `height`: how far the pin of a dyad stands off the line of its bases, as a part of their distance.
fn dyad_spec(
    height: impl Strategy<Value = f64>,
    tilt: impl Strategy<Value = f64>,
) -> impl Strategy<Value = DyadSpec> {
    let side = || prop_oneof![Just(-1.0), Just(1.0)];
    let rrr = (
        any::<Index>(),
        any::<Index>(),
        prop::bool::weighted(0.6),
        (-0.7..0.7_f64, height, side()).prop_map(|(along, across, side)| [along, across * side]),
        [link_spec(), link_spec()],
    )
        .prop_map(|(base, other, fixed, at, links)| DyadSpec::Rrr { base, other, fixed, at, links });
    let writing = prop_oneof![
        Just(GuideWriting::Through),
        Just(GuideWriting::Offset),
        Just(GuideWriting::Toward),
        Just(GuideWriting::Turned),
    ];
    let rrp = (
        any::<Index>(),
        (0.0..TAU, 60.0..180.0_f64).prop_map(|(angle, length)| polar(angle, length)),
        (tilt, side()).prop_map(|(tilt, side)| tilt * side),
        writing,
        any::<bool>(),
        link_spec(),
    )
        .prop_map(|(base, away, tilt, writing, block, link)| DyadSpec::Rrp {
            base,
            away,
            tilt,
            writing,
            block,
            link,
        });
    prop_oneof![3 => rrr, 2 => rrp]
}

fn crank_spec() -> impl Strategy<Value = CrankSpec> {
    let omega = prop_oneof![0.5..40.0_f64, -40.0..-0.5_f64];
    let alpha = prop_oneof![1 => Just(0.0), 3 => -300.0..300.0_f64];
    (30.0..80.0_f64, 0.0..360.0_f64, omega, alpha, link_spec())
        .prop_map(|(length, degrees, omega, alpha, link)| CrankSpec { length, degrees, omega, alpha, link })
}

/// Chains of 3 (a pin in a bare slot) to 10 links, written to four decimals of a millimetre and a degree,
/// well away from dead centres.
pub(crate) fn chains() -> impl Strategy<Value = Chain> {
    (crank_spec(), prop::collection::vec(dyad_spec(0.35..1.1_f64, 0.0..1.1_f64), 1..=4))
        .prop_map(|(crank, dyads)| Maker::build(&crank, &dyads, Some(4)))
}

/// Chains with one group near a dead centre, as near as it likes, and the others well away; numbers to the
/// last digit.
pub(crate) fn flat_chains() -> impl Strategy<Value = Chain> {
    let flat = || (-9.0..-0.5_f64).prop_map(|e| libm::pow(10.0, e));
    let steep = flat().prop_map(|height| std::f64::consts::FRAC_PI_2 - height);
    let healthy = prop::collection::vec(dyad_spec(0.35..1.1_f64, 0.0..1.1_f64), 0..=3);
    (crank_spec(), healthy, dyad_spec(flat(), steep), any::<Index>()).prop_map(
        |(crank, mut dyads, flat, index)| {
            dyads.insert(index.index(dyads.len() + 1), flat);
            Maker::build(&crank, &dyads, None)
        },
    )
}

struct Maker {
    decimals: Option<i32>,
    points: Vec<(String, Xy)>,
    moving: Vec<usize>,
    fixed: Map<String, Value>,
    near: Map<String, Value>,
    links: Map<String, Value>,
    slides: Vec<Value>,
    made: Vec<ChainLink>,
    guides: Vec<Xy>,
    next: u32,
    stiff: bool,
}

impl Maker {
    fn build(crank: &CrankSpec, dyads: &[DyadSpec], decimals: Option<i32>) -> Chain {
        let mut maker = Self {
            decimals,
            points: vec![("O2".to_owned(), [0.0; 2])],
            moving: Vec::new(),
            fixed: Map::from_iter([("O2".to_owned(), json!([0, 0]))]),
            near: Map::new(),
            links: Map::new(),
            slides: Vec::new(),
            made: Vec::new(),
            guides: Vec::new(),
            next: 2,
            stiff: false,
        };
        let input = maker.crank(crank);
        for dyad in dyads {
            match dyad {
                DyadSpec::Rrr { base, other, fixed, at, links } => {
                    maker.rrr(*base, *other, *fixed, *at, links);
                }
                DyadSpec::Rrp { base, away, tilt, writing, block, link } => {
                    maker.rrp(*base, *away, *tilt, *writing, *block, link);
                }
            }
        }
        maker.finish(input)
    }

    fn rounded(&self, value: f64) -> f64 {
        match self.decimals {
            Some(decimals) => format!("{value:.*}", usize::try_from(decimals).unwrap()).parse().unwrap(),
            None => value,
        }
    }

    fn rounded_place(&self, at: Xy) -> Xy {
        at.map(|x| self.rounded(x))
    }

    fn number(&mut self) -> u32 {
        self.next += 1;
        self.next - 1
    }

    fn name(&self, letter: char) -> String {
        format!("{letter}{}", self.points.len())
    }

    fn note(&mut self, name: &str, at: Xy) -> usize {
        self.points.push((name.to_owned(), at));
        self.points.len() - 1
    }

    fn moving_point(&self, index: Index) -> usize {
        self.moving[index.index(self.moving.len())]
    }

    /// Writes a link with these two joints (their distance is the length) and perhaps a third point, and
    /// says where the third point stands in the frame of the two: along from the first, and across.
    fn write(
        &mut self,
        number: u32,
        joints: [&str; 2],
        length: f64,
        spec: &LinkSpec,
    ) -> Option<(String, Xy)> {
        let name = self.name('P');
        let own = [[0.0; 2], [length, 0.0], scaled(spec.third, length)];
        let orders = [[0, 1, 2], [1, 0, 2], [2, 0, 1], [0, 2, 1], [1, 2, 0], [2, 1, 0]];
        let order = orders[spec.order];
        let names = [joints[0], joints[1], name.as_str()];
        let joins = order.map(|i| names[i]);
        let p = order.map(|i| own[i]);
        let distance = |a: Xy, b: Xy| self.rounded(norm(minus(b, a)));
        // Where the third point is, once the numbers are rounded.
        let mut third = own[2];
        let dimension = match spec.writing {
            Writing::Length => {
                let joins = if spec.order.is_multiple_of(2) { joints } else { [joints[1], joints[0]] };
                self.links.insert(number.to_string(), json!({ "joins": joins, "length": length }));
                let joins = joins.map(str::to_owned).to_vec();
                self.made.push(ChainLink { number, joins });
                return None;
            }
            Writing::Line => {
                let positions = [0.0, length, self.rounded(spec.third[0] * length)];
                third = [positions[2], 0.0];
                // Positions count from anywhere; the two joints' must differ by just the length.
                json!({ "line": order.map(|i| positions[i]) })
            }
            Writing::Sides => {
                let mut sides = [distance(p[0], p[1]), distance(p[1], p[2]), distance(p[2], p[0])];
                // The side between the two joints is their distance as it stands.
                let of = |a: usize, b: usize| {
                    (0..3)
                        .find(|&k| {
                            [order[k], order[(k + 1) % 3]] == [a, b]
                                || [order[k], order[(k + 1) % 3]] == [b, a]
                        })
                        .unwrap()
                };
                sides[of(0, 1)] = length;
                let (r0, r1) = (sides[of(0, 2)], sides[of(1, 2)]);
                let along = (length * length + r0 * r0 - r1 * r1) / (2.0 * length);
                let across = (r0 * r0 - along * along).max(0.0).sqrt();
                third = [along, across.copysign(spec.third[1])];
                let ccw = cross(minus(p[1], p[0]), minus(p[2], p[0])) > 0.0;
                json!({ "sides": sides, "turn": if ccw { "ccw" } else { "cw" } })
            }
            Writing::Arms | Writing::Shape => {
                // Arms meet at the first joint of the two; the other orders are written as a shape.
                let arms = spec.writing == Writing::Arms && order[0] == 0;
                if arms {
                    let r = self.rounded(norm(own[2]));
                    let angle = self.rounded(libm::atan2(own[2][1], own[2][0]).to_degrees());
                    third = polar(angle.to_radians(), r);
                    if order[1] == 1 {
                        json!({ "arms": [length, r, angle] })
                    } else {
                        json!({ "arms": [r, length, -angle] })
                    }
                } else {
                    // In own coordinates that are turned by a quarter and shifted.
                    third = self.rounded_place(third);
                    let shape = [[0.0; 2], [length, 0.0], third].map(|q| [0.5 - q[1], q[0]]);
                    third = [shape[2][1], 0.5 - shape[2][0]];
                    let places: Map<String, Value> =
                        order.iter().map(|&i| (names[i].to_owned(), json!(shape[i]))).collect();
                    json!({ "shape": places })
                }
            }
        };
        let mut link = dimension;
        link["joins"] = json!(joins);
        self.links.insert(number.to_string(), link);
        let joins = joins.map(str::to_owned).to_vec();
        self.made.push(ChainLink { number, joins });
        Some((name, third))
    }

    /// Notes a third point that stands so against two places.
    fn note_third(&mut self, third: Option<(String, Xy)>, from: Xy, to: Xy) {
        let Some((name, [along, across])) = third else { return };
        let way = unit(minus(to, from));
        let at = plus(from, plus(scaled(way, along), scaled(left(way), across)));
        let index = self.note(&name, at);
        self.moving.push(index);
    }

    fn crank(&mut self, spec: &CrankSpec) -> Value {
        let number = self.number();
        let length = self.rounded(spec.length);
        let degrees = self.rounded(spec.degrees);
        // The angle is that of the line from the first joint to the second, whichever these are.
        let third = self.write(number, ["O2", "A"], length, &spec.link);
        let joins = self.made[0].joins.clone();
        let own = |name: &str| match name {
            "O2" => [0.0; 2],
            "A" => [length, 0.0],
            _ => third.as_ref().unwrap().1,
        };
        let line = minus(own(&joins[1]), own(&joins[0]));
        let along = degrees.to_radians() - libm::atan2(line[1], line[0]);
        // A straight link's line runs from its first joint to its second even where positions fall.
        let at = polar(along, length);
        let index = self.note("A", at);
        self.moving.push(index);
        // The name of the third point was chosen before `A` was noted.
        self.note_third(third, [0.0; 2], at);
        json!({
            "link": number, "angle": degrees,
            "omega": self.rounded(spec.omega), "alpha": self.rounded(spec.alpha),
        })
    }

    fn rrr(&mut self, base: Index, other: Index, fixed: bool, at: Xy, links: &[LinkSpec; 2]) {
        let first = self.moving_point(base);
        let p = self.points[first].1;
        let candidates: Vec<usize> = self
            .moving
            .iter()
            .copied()
            .filter(|&i| {
                let d = norm(minus(self.points[i].1, p));
                d > 40.0 && d < 400.0
            })
            .collect();
        let second = if fixed || candidates.is_empty() {
            // A new pivot where the other base would be.
            let way = polar(at[0] * 4.0 + f64::from(self.next), 90.0 + 60.0 * at[0]);
            let name = format!("O{}", self.next + 1);
            let place = self.rounded_place(plus(p, way));
            self.fixed.insert(name.clone(), json!(place));
            self.note(&name, place)
        } else {
            candidates[other.index(candidates.len())]
        };
        let q = self.points[second].1;
        let d = norm(minus(q, p));
        let way = unit(minus(q, p));
        let size = if at[1].abs() > 0.3 { d.max(60.0) } else { d };
        let middle = plus(p, scaled(minus(q, p), 0.5));
        let wanted = plus(middle, plus(scaled(way, at[0] * 0.6 * d), scaled(left(way), at[1] * size)));
        let (r1, r2) = (self.rounded(norm(minus(wanted, p))), self.rounded(norm(minus(wanted, q))));
        // The pin for the lengths as written.
        let along = (d * d + (r1 - r2) * (r1 + r2)) / (2.0 * d);
        let across = ((r1 - along) * (r1 + along)).max(0.0).sqrt().copysign(at[1]);
        let pin = plus(p, plus(scaled(way, along), scaled(left(way), across)));
        let name = self.name('B');
        let (base_name, other_name) = (self.points[first].0.clone(), self.points[second].0.clone());
        let of_one_link = |link: &ChainLink| [&base_name, &other_name].iter().all(|n| link.joins.contains(n));
        self.stiff |= self.made.iter().any(of_one_link);
        let index = self.note(&name, pin);
        self.near(&name, pin, across.abs());
        let numbers = [self.number(), self.number()];
        let third = self.write(numbers[0], [&base_name, &name], r1, &links[0]);
        self.note_third(third, p, pin);
        let third = self.write(numbers[1], [&other_name, &name], r2, &links[1]);
        self.note_third(third, q, pin);
        self.moving.push(index);
    }

    fn rrp(&mut self, base: Index, away: Xy, tilt: f64, writing: GuideWriting, block: bool, link: &LinkSpec) {
        let base = self.moving_point(base);
        let p = self.points[base].1;
        let wanted = plus(p, away);
        let length = self.rounded(norm(away));
        let slope = self.rounded((libm::atan2(away[1], away[0]) + tilt).to_degrees());
        let mut way = polar(slope.to_radians(), 1.0);
        let back = plus(wanted, scaled(way, -50.0));
        let (on, through) = match writing {
            GuideWriting::Through | GuideWriting::Turned => {
                let through = self.rounded_place(back);
                let on = match writing {
                    GuideWriting::Through => json!({ "link": 1, "through": through, "angle": slope }),
                    _ => json!({ "link": 1, "through": through, "angle": slope - 30.0, "turned": 30 }),
                };
                (on, through)
            }
            GuideWriting::Offset => {
                let offset = self.rounded(cross(way, wanted));
                let on = json!({ "link": 1, "through": "O2", "angle": slope, "offset": offset });
                (on, scaled(left(way), offset))
            }
            GuideWriting::Toward => {
                let through = self.rounded_place(back);
                let name = self.name('Q');
                let toward = self.rounded_place(plus(wanted, scaled(way, 70.0)));
                self.fixed.insert(name.clone(), json!(toward));
                self.note(&name, toward);
                way = unit(minus(toward, through));
                (json!({ "link": 1, "through": through, "toward": name }), through)
            }
        };
        // The pin for the numbers as written: further along the guide, or nearer, whichever was wanted.
        let foot = dot(minus(p, through), way);
        let off = cross(way, minus(p, through));
        let half = ((length - off) * (length + off)).max(0.0).sqrt();
        let forward = if dot(minus(wanted, through), way) > foot { foot + half } else { foot - half };
        let pin = plus(through, scaled(way, forward));
        let name = self.name('D');
        let base_name = self.points[base].0.clone();
        let index = self.note(&name, pin);
        self.near(&name, pin, half);
        let number = self.number();
        let third = self.write(number, [&base_name, &name], length, link);
        self.note_third(third, p, pin);
        self.moving.push(index);
        let mut slide = json!({ "pin": name, "on": on });
        if block {
            slide["block"] = json!(self.number());
        }
        self.slides.push(slide);
        self.guides.push(way);
    }

    /// A rough place: a tenth of the way off that would lead to the other assembly.
    fn near(&mut self, name: &str, at: Xy, half: f64) {
        let rough = plus(at, polar(at[0] + at[1], 0.1 * half));
        self.near.insert(name.to_owned(), json!(rough));
    }

    fn finish(self, input: Value) -> Chain {
        let moving = || self.moving.iter().map(|&i| self.points[i].0.as_str());
        let mut find: Vec<String> = Vec::new();
        for name in moving() {
            find.extend([format!("x({name})"), format!("v({name})"), format!("a({name})")]);
        }
        for link in &self.made {
            find.extend([format!("omega({})", link.number), format!("alpha({})", link.number)]);
            find.push(format!("angle({})", link.number));
            let (b, a) = (&link.joins[1], &link.joins[0]);
            for part in ["v", "a", "an", "at"] {
                // Of a fixed point nothing is asked relative to a moving one.
                if !self.fixed.contains_key(b) {
                    find.push(format!("{part}({b}/{a})"));
                }
            }
        }
        let scene = json!({
            "units": { "length": "mm" },
            "fixed": self.fixed, "links": self.links, "slides": self.slides, "near": self.near,
            "input": input, "find": find,
        });
        Chain {
            text: serde_json::to_string_pretty(&scene).unwrap(),
            places: self.points.iter().map(|(n, p)| (n.clone(), scaled(*p, 0.001))).collect(),
            links: self.made,
            guides: self.guides,
            count: usize::try_from(self.next).unwrap() - 1,
            stiff: self.stiff,
        }
    }
}
