//! Mechanisms as a student meets them: a driven crank, then group after group. Random ones, with their scene files.

use serde_json::{Map, Value, json};

use super::plane::{Chance, O, Xy, xy};

/// Unit of the scene's lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Unit {
    Mm,
    Cm,
    Inch,
    Foot,
}

impl Unit {
    pub(crate) fn symbol(self) -> &'static str {
        match self {
            Self::Mm => "mm",
            Self::Cm => "cm",
            Self::Inch => "in",
            Self::Foot => "ft",
        }
    }

    /// Millimetres.
    pub(crate) fn mm(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Cm => 10.0,
            Self::Inch => 25.4,
            Self::Foot => 304.8,
        }
    }
}

/// A step of the mechanism, with the data that the question gives.
#[derive(Debug, Clone)]
pub(crate) enum Group {
    /// Coupler from a known pin and rocker from a fixed pivot, joined at `pin`.
    Dyad {
        coupler: &'static str,
        from: &'static str,
        coupler_length: f64,
        rocker: &'static str,
        pivot: &'static str,
        rocker_length: f64,
        pin: &'static str,
        /// +1: the pin lies to the left of the way from `from` to the pivot.
        side: f64,
    },
    /// A further point of a link with two known points; `shape` is its place over first→second as a complex number.
    Further { link: &'static str, first: &'static str, second: &'static str, point: &'static str, shape: Xy },
    /// Rod from a known pin to a block on a fixed guide.
    Slider {
        rod: &'static str,
        from: &'static str,
        length: f64,
        pin: &'static str,
        through: Xy,
        /// Radians.
        angle: f64,
        /// +1: the farther of both places along the guide.
        side: f64,
    },
    /// The crank's pin slides on a lever about a fixed pivot; the lever's end lies `length` from the pivot, toward
    /// the pin (+1) or beyond the pivot (−1).
    Lever {
        pin: &'static str,
        lever: &'static str,
        pivot: &'static str,
        end: &'static str,
        length: f64,
        side: f64,
    },
    /// A rod from the crank's pin slides through a swivelling guide at a fixed pivot; its end lies `length` from the pin.
    Cylinder {
        pin: &'static str,
        rod: &'static str,
        swivel: &'static str,
        pivot: &'static str,
        end: &'static str,
        length: f64,
    },
}

/// A mechanism in the units of its scene, seconds and radians.
#[derive(Debug, Clone)]
pub(crate) struct Mechanism {
    pub(crate) family: &'static str,
    pub(crate) unit: Unit,
    /// Fixed points.
    pub(crate) fixed: Vec<(&'static str, Xy)>,
    pub(crate) crank: f64,
    /// Radians.
    pub(crate) angle: f64,
    /// ω of the crank as the question states it, ccw positive: in rpm or in rad/s.
    pub(crate) omega: f64,
    pub(crate) rpm: bool,
    /// α of the crank in rad/s².
    pub(crate) alpha: f64,
    pub(crate) groups: Vec<Group>,
    /// Levers' ends are found by the image and not computed from ω and α.
    pub(crate) by_image: bool,
}

pub(crate) const FAMILIES: [&str; 9] = [
    "four-bar",
    "four-bar with coupler point",
    "slider-crank",
    "slotted lever",
    "crank-shaper",
    "Whitworth",
    "oscillating cylinder",
    "six-bar with slider",
    "Watt chain",
];

fn round(value: f64, step: f64) -> f64 {
    (value / step).round() * step
}

/// As it would stand in a question: three digits.
fn tidy(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap()
}

fn tidy_at(p: Xy) -> Xy {
    xy(tidy(p.x), tidy(p.y))
}

impl Mechanism {
    /// A random mechanism of a family. Whether it goes together is seen when it is solved.
    pub(crate) fn random(family: &'static str, chance: &mut Chance) -> Self {
        let unit = *chance.pick(&[Unit::Mm, Unit::Cm, Unit::Inch, Unit::Foot]);
        // A crank of some 60 mm on paper's scale, in whatever unit.
        let r = tidy(match unit {
            Unit::Mm => chance.between(40.0, 300.0),
            Unit::Cm => chance.between(5.0, 40.0),
            Unit::Inch => chance.between(2.0, 12.0),
            Unit::Foot => chance.between(0.5, 2.0),
        });
        let rpm = chance.coin();
        let omega = round(if rpm { chance.between(40.0, 300.0) } else { chance.between(4.0, 30.0) }, 0.5)
            * chance.sign();
        let w = if rpm { omega * std::f64::consts::TAU / 60.0 } else { omega };
        let alpha = if chance.coin() { tidy(w * w * chance.between(0.3, 0.9)) * chance.sign() } else { 0.0 };
        let angle = round(chance.between(0.0, 360.0), 1.0).to_radians();
        let tilt = if chance.coin() { 0.0 } else { round(chance.between(-60.0, 60.0), 5.0).to_radians() };
        let mut fixed = vec![("O2", O)];
        let mut groups = Vec::new();
        let dyad = |chance: &mut Chance, fixed: &mut Vec<_>| {
            fixed.push(("O4", tidy_at(Xy::polar(r * chance.between(2.2, 3.4), tilt))));
            Group::Dyad {
                coupler: "3",
                from: "A",
                coupler_length: tidy(r * chance.between(1.8, 3.4)),
                rocker: "4",
                pivot: "O4",
                rocker_length: tidy(r * chance.between(1.4, 2.6)),
                pin: "B",
                side: chance.sign(),
            }
        };
        let rod = |chance: &mut Chance, from, about: Xy, square: f64| Group::Slider {
            rod: "5",
            from,
            length: tidy(r * chance.between(1.8, 3.0)),
            pin: "D",
            through: tidy_at(about),
            angle: round(square.to_degrees(), 5.0).to_radians(),
            side: chance.sign(),
        };
        match family {
            "four-bar" => groups.push(dyad(chance, &mut fixed)),
            "four-bar with coupler point" => {
                groups.push(dyad(chance, &mut fixed));
                let shape = Xy::polar(chance.between(0.5, 1.2), chance.sign() * chance.between(0.4, 1.2));
                groups.push(Group::Further { link: "3", first: "A", second: "B", point: "P", shape });
            }
            "slider-crank" => {
                let offset = if chance.coin() { 0.0 } else { tidy(r * chance.between(-0.8, 0.8)) };
                groups.push(Group::Slider {
                    rod: "3",
                    from: "A",
                    length: tidy(r * chance.between(2.0, 3.5)),
                    pin: "B",
                    through: tidy_at(Xy::polar(offset, tilt).left()),
                    angle: tilt,
                    side: chance.sign(),
                });
            }
            "slotted lever" | "crank-shaper" | "Whitworth" => {
                let ground =
                    if family == "Whitworth" { chance.between(0.35, 0.65) } else { chance.between(1.8, 2.6) };
                let pivot = tidy_at(Xy::polar(r * ground, tilt - std::f64::consts::FRAC_PI_2));
                fixed.push(("O4", pivot));
                let length = tidy(if family == "Whitworth" {
                    r * chance.between(0.8, 1.5)
                } else {
                    r * chance.between(3.2, 4.2)
                });
                let side = if family == "Whitworth" { chance.sign() } else { 1.0 };
                groups.push(Group::Lever { pin: "A", lever: "4", pivot: "O4", end: "C", length, side });
                let stroke = tilt;
                if family == "crank-shaper" {
                    let about = pivot + Xy::polar(r * chance.between(3.4, 4.4), tilt).left();
                    groups.push(rod(chance, "C", about, stroke));
                } else if family == "Whitworth" {
                    groups.push(rod(chance, "C", pivot, stroke));
                }
            }
            "oscillating cylinder" => {
                fixed.push(("O4", tidy_at(Xy::polar(r * chance.between(2.5, 3.5), tilt))));
                let length = tidy(r * chance.between(1.8, 3.0));
                groups.push(Group::Cylinder {
                    pin: "A",
                    rod: "3",
                    swivel: "4",
                    pivot: "O4",
                    end: "P",
                    length,
                });
            }
            "six-bar with slider" | "Watt chain" => {
                groups.push(dyad(chance, &mut fixed));
                let pivot = fixed[1].1;
                let shape = if chance.coin() {
                    xy(tidy(-chance.between(0.6, 1.3)), 0.0)
                } else {
                    Xy::polar(chance.between(0.8, 1.4), chance.sign() * chance.between(0.5, 1.5))
                };
                groups.push(Group::Further { link: "4", first: "O4", second: "B", point: "C", shape });
                if family == "Watt chain" {
                    let away = Xy::polar(r * chance.between(2.0, 3.2), chance.between(-1.5, 1.5) + tilt);
                    fixed.push(("O6", tidy_at(pivot + away)));
                    groups.push(Group::Dyad {
                        coupler: "5",
                        from: "C",
                        coupler_length: tidy(r * chance.between(1.8, 3.0)),
                        rocker: "6",
                        pivot: "O6",
                        rocker_length: tidy(r * chance.between(1.4, 2.6)),
                        pin: "D",
                        side: chance.sign(),
                    });
                } else {
                    let about = pivot + Xy::polar(r * chance.between(-1.5, 1.5), chance.between(0.0, 3.0));
                    let square = chance.between(0.0, 3.1);
                    groups.push(rod(chance, "C", about, square));
                }
            }
            other => panic!("no family {other}"),
        }
        Self { family, unit, fixed, crank: r, angle, omega, rpm, alpha, groups, by_image: chance.coin() }
    }

    pub(crate) fn fixed(&self, name: &str) -> Xy {
        self.fixed.iter().find(|(n, _)| *n == name).unwrap().1
    }

    /// The scene file; `places` choose the assembly, `find` is what is asked.
    pub(crate) fn scene(&self, places: &[(String, Xy)], find: &[String]) -> String {
        let mut links = Map::new();
        let mut slides = Vec::new();
        links.insert("2".into(), json!({ "joins": ["O2", "A"], "length": self.crank }));
        let place = |name: &str| {
            let found = places.iter().find(|(n, _)| n == name).map(|(_, p)| *p);
            found.unwrap_or_else(|| self.fixed(name))
        };
        for group in &self.groups {
            match *group {
                Group::Dyad { coupler, from, coupler_length, rocker, pivot, rocker_length, pin, .. } => {
                    links.insert(coupler.into(), json!({ "joins": [from, pin], "length": coupler_length }));
                    links.insert(rocker.into(), json!({ "joins": [pivot, pin], "length": rocker_length }));
                }
                Group::Further { link, first, second, point, shape } => {
                    let length = links[link]["length"].as_f64().unwrap();
                    let own = shape * length;
                    links.insert(
                        link.into(),
                        json!({ "joins": [first, second, point],
                                "shape": { first: [0, 0], second: [length, 0], point: [own.x, own.y] } }),
                    );
                }
                Group::Slider { rod, from, length, pin, through, angle, .. } => {
                    links.insert(rod.into(), json!({ "joins": [from, pin], "length": length }));
                    let block = rod.parse::<u32>().unwrap() + 1;
                    slides.push(json!({ "pin": pin, "block": block,
                        "on": { "link": 1, "through": [through.x, through.y], "angle": angle.to_degrees() } }));
                }
                Group::Lever { pin, lever, pivot, end, length, .. } => {
                    links.insert(lever.into(), json!({ "joins": [pivot, end], "length": length }));
                    slides.push(json!({ "pin": pin, "block": 3,
                        "on": { "link": 4, "through": pivot, "toward": end } }));
                }
                Group::Cylinder { pin, rod, swivel, pivot, end, length } => {
                    links.insert(rod.into(), json!({ "joins": [pin, end], "length": length }));
                    links.insert(swivel.into(), json!({ "joins": [pivot] }));
                    // The rod's own x-axis runs from the pin through the swivel, the guide's from the swivel to the pin.
                    slides.push(json!({ "link": rod.parse::<u32>().unwrap(), "turned": 180, "on": { "link": 4, "through": pivot, "angle": 0 } }));
                }
            }
        }
        let driven = match self.groups[0] {
            Group::Cylinder { .. } => vec![],
            _ => places.iter().filter(|(n, _)| n != "A").map(|(n, _)| (n.clone(), place(n))).collect(),
        };
        let near: Map<String, Value> = driven
            .iter()
            .map(|(n, p)| (n.clone(), json!([round(p.x, self.crank / 20.0), round(p.y, self.crank / 20.0)])))
            .collect();
        let sense = |value: f64| if value < 0.0 { "cw" } else { "ccw" };
        let unit = if self.rpm { "rpm" } else { "rad/s" };
        let mut input = json!({ "link": 2, "angle": self.angle.to_degrees(),
            "omega": format!("{} {unit} {}", self.omega.abs(), sense(self.omega)) });
        if self.alpha != 0.0 {
            input["alpha"] = json!(format!("{} rad/s^2 {}", self.alpha.abs(), sense(self.alpha)));
        }
        let fixed: Map<String, Value> =
            self.fixed.iter().map(|(n, p)| ((*n).into(), json!([p.x, p.y]))).collect();
        let mut scene = json!({ "title": self.family, "units": { "length": self.unit.symbol() }, "fixed": fixed,
            "links": links, "input": input, "find": find });
        if !slides.is_empty() {
            scene["slides"] = json!(slides);
        }
        if !near.is_empty() {
            scene["near"] = json!(near);
        }
        serde_json::to_string_pretty(&scene).unwrap()
    }
}
