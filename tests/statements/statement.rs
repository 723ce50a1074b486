//! One of the many ways to say a mechanism as a scene.

use serde_json::{Map, Value, json};

use super::mechanism::{
    Contact, Driver, FRAME, Kind, Mechanism, Path, Place, Rider, Slide, angle, cross, direction, dot, left,
    length, minus, plus, unit,
};
use super::truth::Told;
use crate::extremes::dice::Dice;

const TURN: f64 = 2.0 * std::f64::consts::PI;

/// A unit by its name and what it is in SI.
type Unit = (&'static str, f64);

const LENGTHS: [Unit; 7] =
    [("m", 1.0), ("mm", 1e-3), ("cm", 1e-2), ("km", 1e3), ("in", 0.0254), ("ft", 0.3048), ("um", 1e-6)];
const ANGLES: [Unit; 3] = [("deg", TURN / 360.0), ("rad", 1.0), ("rev", TURN)];
const TIMES: [Unit; 3] = [("s", 1.0), ("ms", 1e-3), ("min", 60.0)];

/// The units of a scene.
#[derive(Clone, Copy)]
pub(crate) struct Units {
    pub(crate) length: Unit,
    pub(crate) angle: Unit,
    pub(crate) time: Unit,
}

/// How a scene says where a link is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Dimensions {
    None,
    Length,
    Line,
    Sides,
    Arms,
    Shape,
}

/// A link's own coordinates.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Own {
    origin: Place,
    /// Of the x-axis in the world.
    pub(crate) angle: f64,
    /// The contract leaves no doubt about the x-axis.
    pub(crate) sure: bool,
}

impl Own {
    const WORLD: Self = Self { origin: [0.0, 0.0], angle: 0.0, sure: true };

    fn of(self, at: Place) -> Place {
        if self.angle == 0.0 {
            return minus(at, self.origin);
        }
        let x = direction(self.angle);
        let arm = minus(at, self.origin);
        [dot(arm, x), cross(x, arm)]
    }
}

/// A scene and what its writer knows of it.
pub(crate) struct Said {
    pub(crate) scene: Value,
    pub(crate) units: Units,
    /// By body.
    pub(crate) own: Vec<Own>,
    /// Radii of journals by point, in the scene's unit.
    pub(crate) journals: Vec<Option<f64>>,
    /// How, for the tables.
    pub(crate) ways: Vec<&'static str>,
    /// What it says of places.
    pub(crate) told: Told,
}

struct Writer<'a> {
    dice: &'a mut Dice,
    m: &'a Mechanism,
    units: Units,
    placed: Vec<bool>,
    own: Vec<Own>,
    dimensions: Vec<Dimensions>,
    /// In what order each link names its points.
    joins: Vec<Vec<usize>>,
    /// By slide: the guide is said the other way round.
    flipped: Vec<bool>,
    /// By slide: from the stated direction to the rider's own x-axis.
    turned: Vec<f64>,
    /// Strings with units now and then.
    wordy: bool,
}

fn number(x: f64) -> Value {
    let x = if x == 0.0 { 0.0 } else { x };
    if x.abs() < 1e9 && x.fract() == 0.0 {
        #[expect(clippy::cast_possible_truncation, reason = "it is a small whole number")]
        return json!(x as i64);
    }
    json!(x)
}

/// An angle within half a turn of nought.
fn folded(angle: f64) -> f64 {
    angle - TURN * (angle / TURN).round()
}

impl Writer<'_> {
    fn words(&mut self) -> bool {
        self.wordy && self.dice.chance(0.3)
    }

    fn length(&mut self, x: f64) -> Value {
        if !self.words() {
            return number(x);
        }
        let other = self.dice.of(&LENGTHS[..4]);
        if other.0 == self.units.length.0 || self.dice.chance(0.3) {
            return json!(format!("{x} {}", self.units.length.0));
        }
        json!(format!("{} {}", x * self.units.length.1 / other.1, other.0))
    }

    /// Of a geometrical angle in radians; any number of turns.
    fn angle(&mut self, radians: f64) -> Value {
        let mut a = folded(radians);
        if self.dice.chance(0.15) {
            a += TURN * self.dice.side();
        }
        if !self.words() {
            return number(tidy(a / self.units.angle.1));
        }
        let unit = self.dice.of(&ANGLES);
        json!(format!("{} {}", tidy(a / unit.1), unit.0))
    }

    fn sensed(&mut self, x: f64, unit: &str) -> Value {
        match self.dice.below(3) {
            0 => json!(format!("{x} {unit}")),
            1 => json!(format!("{x} {unit} ccw")),
            _ => json!(format!("{} {unit} cw", -x)),
        }
    }

    /// A rate of turning, of the first or second order.
    fn turning(&mut self, x: f64, order: i32) -> Value {
        let time = self.units.time;
        if self.wordy && self.dice.chance(0.5) || !self.wordy && self.dice.chance(0.2) {
            if order == 1 && self.dice.chance(0.3) {
                let rpm = x / time.1 / TURN * 60.0;
                return self.sensed(rpm, "rpm");
            }
            let other = self.dice.of(&TIMES);
            let angle = self.dice.of(&ANGLES);
            let by = if order == 1 { other.0.to_owned() } else { format!("{}^2", other.0) };
            let factor = other.1 / time.1;
            let factor = if order == 1 { factor } else { factor * factor };
            return self.sensed(x * factor / angle.1, &format!("{}/{by}", angle.0));
        }
        if self.dice.chance(0.2) {
            return match self.dice.below(2) {
                0 => json!(format!("{x} ccw")),
                _ => json!(format!("{} cw", -x)),
            };
        }
        number(x)
    }

    /// A rate of length.
    fn running(&mut self, x: f64, order: i32) -> Value {
        if !self.words() {
            return number(x);
        }
        let (length, time) = (self.dice.of(&LENGTHS[..4]), self.dice.of(&TIMES));
        let factor = time.1 / self.units.time.1;
        let factor = if order == 1 { factor } else { factor * factor };
        let by = if order == 1 { time.0.to_owned() } else { format!("{}^2", time.0) };
        json!(format!("{} {}/{by}", x * self.units.length.1 / length.1 * factor, length.0))
    }

    fn place(&mut self, at: Place) -> Value {
        let [x, y] = at;
        json!([self.length(x), self.length(y)])
    }

    fn name(&self, point: usize) -> &str {
        &self.m.points[point].name
    }

    fn stands(&self, point: usize) -> bool {
        self.m.is_fixed(point) || self.placed[point]
    }

    fn all_stand(&self, body: usize) -> bool {
        body == FRAME || self.joins[body].iter().all(|p| self.stands(*p))
    }

    /// The stated direction of a slide's guide.
    fn along(&self, slide: usize) -> Option<Place> {
        let Path::Line { along, .. } = self.m.slides[slide].path else { return None };
        Some(if self.flipped[slide] { [-along[0], -along[1]] } else { along })
    }

    fn choose_dimensions(&mut self, body: usize) {
        let joins = self.joins[body].clone();
        let here: Vec<Place> = joins.iter().map(|p| self.m.at(*p)).collect();
        if here.len() < 2 {
            return;
        }
        if self.all_stand(body) && self.dice.chance(0.7) {
            return;
        }
        let straight = here.iter().all(|p| {
            cross(unit(minus(here[1], here[0])), minus(*p, here[0])).abs()
                < 1e-9 * length(minus(here[1], here[0]))
        });
        let mut ways = vec![Dimensions::Shape];
        if straight {
            ways.extend([Dimensions::Line, Dimensions::Line]);
        }
        match here.len() {
            2 => ways.extend([Dimensions::Length, Dimensions::Length, Dimensions::Length]),
            3 => {
                ways.push(Dimensions::Arms);
                if !straight {
                    ways.extend([Dimensions::Arms, Dimensions::Sides, Dimensions::Sides]);
                }
            }
            _ => {}
        }
        let way = self.dice.of(&ways);
        self.dimensions[body] = way;
        let toward = angle(minus(here[1], here[0]));
        self.own[body] = match way {
            Dimensions::Line => {
                let x = if self.dice.chance(0.3) { toward + TURN / 2.0 } else { toward };
                let zero = if self.dice.chance(0.7) { 0.0 } else { self.dice.between(-2.0, 2.0) };
                Own { origin: plus(here[0], direction(x), zero), angle: x, sure: true }
            }
            Dimensions::Shape => {
                let x = if self.dice.chance(0.5) { toward } else { self.dice.between(-3.0, 3.0) };
                let origin = if self.dice.chance(0.6) {
                    here[0]
                } else {
                    plus(here[0], [self.dice.between(-3.0, 3.0), self.dice.between(-3.0, 3.0)], 1.0)
                };
                Own { origin, angle: x, sure: true }
            }
            _ => Own { origin: here[0], angle: toward, sure: true },
        };
    }

    fn own_of_one_joint(&mut self, body: usize) {
        let joint = self.joins[body][0];
        let origin = self.m.at(joint);
        for (i, slide) in self.m.slides.iter().enumerate() {
            if slide.rider == Rider::Link(body) {
                let turned = if self.dice.chance(0.6) { 0.0 } else { self.dice.between(-2.0, 2.0) };
                self.turned[i] = turned;
                let Some(along) = self.along(i) else { continue };
                self.own[body] = Own { origin, angle: angle(along) + turned, sure: true };
                return;
            }
            if slide.on == body && slide.swivel {
                let (rider, _) = self.m.rider(slide);
                let toward = minus(self.m.at(rider), origin);
                self.flipped[i] = matches!(slide.path, Path::Line { along, .. } if dot(along, toward) < 0.0);
                self.own[body] = Own { origin, angle: angle(toward), sure: true };
                return;
            }
        }
        self.own[body] = Own { origin, angle: 0.0, sure: true };
    }

    /// A straight guide of a body, with the place on it from which it counts.
    fn line(
        &mut self,
        on: usize,
        through: Place,
        along: Place,
        swivel: bool,
        link_said: bool,
    ) -> (Map<String, Value>, Place) {
        let mut guide = Map::new();
        let number = self.m.bodies[on].number;
        if on != FRAME || link_said || self.dice.chance(0.7) {
            guide.insert("link".into(), json!(number));
        }
        if swivel {
            let joint = self.joins[on][0];
            guide.insert("through".into(), json!(self.name(joint)));
            if self.dice.chance(0.3) {
                guide.insert("angle".into(), json!(0));
            }
            return (guide, self.m.at(joint));
        }
        let points: Vec<usize> =
            (0..self.m.points.len()).filter(|p| self.m.points[*p].of.contains(&on)).collect();
        let own = self.own[on];
        let mut from = through;
        let mut from_point = None;
        let mut offset = 0.0;
        if !points.is_empty() && self.dice.chance(0.5) {
            let on_line: Vec<usize> = points
                .iter()
                .copied()
                .filter(|p| cross(along, minus(self.m.at(*p), through)).abs() < 1e-9 * self.m.size())
                .collect();
            let choice = if !on_line.is_empty() && self.dice.chance(0.7) {
                self.dice.of(&on_line)
            } else {
                self.dice.of(&points)
            };
            from_point = Some(choice);
            from = self.m.at(choice);
            // Left of the line is where its offset goes.
            if !on_line.contains(&choice) {
                offset = cross(along, minus(through, from));
            }
        } else {
            if self.dice.chance(0.3) {
                offset = self.dice.between(-1.0, 1.0) * self.m.size() * 0.3;
            }
            let run = self.dice.between(-0.3, 0.3) * self.m.size();
            let run = if self.dice.chance(0.5) { 0.0 } else { run };
            from = plus(plus(from, along, run), left(along), -offset);
        }
        match from_point {
            Some(point) => guide.insert("through".into(), json!(self.name(point))),
            None => {
                let place = self.place(own.of(from));
                guide.insert("through".into(), place)
            }
        };
        let others: Vec<usize> = points
            .iter()
            .copied()
            .filter(|p| length(minus(self.m.at(*p), from)) > 0.05 * self.m.size())
            .collect();
        let mut turned;
        if !others.is_empty() && self.dice.chance(0.5) {
            let toward = self.dice.of(&others);
            guide.insert("toward".into(), json!(self.name(toward)));
            turned = folded(angle(along) - angle(minus(self.m.at(toward), from)));
        } else {
            let inclined = folded(angle(along) - own.angle);
            turned = if self.dice.chance(0.25) { self.dice.between(-2.0, 2.0) } else { 0.0 };
            if (inclined - turned).abs() > 1e-12 || self.dice.chance(0.5) {
                let value = self.angle(inclined - turned);
                guide.insert("angle".into(), value);
            }
        }
        if turned.abs() < 1e-12 {
            turned = 0.0;
        }
        if turned != 0.0 {
            let value = self.angle(turned);
            guide.insert("turned".into(), value);
        }
        if offset != 0.0 {
            let value = self.length(offset);
            guide.insert("offset".into(), value);
        }
        (guide, plus(from, left(along), offset))
    }

    fn slide(&mut self, index: usize) -> (Value, Place) {
        let slide = self.m.slides[index];
        let mut said = Map::new();
        match slide.rider {
            Rider::Pin { point, block } => {
                said.insert("pin".into(), json!(self.name(point)));
                if let Some(block) = block {
                    said.insert("block".into(), json!(self.m.bodies[block].number));
                }
            }
            Rider::Link(body) => {
                said.insert("link".into(), json!(self.m.bodies[body].number));
                let along = self.along(index).unwrap_or([1.0, 0.0]);
                if self.joins[body].len() > 1 && self.dimensions[body] != Dimensions::None {
                    self.turned[index] = folded(self.own[body].angle - angle(along));
                }
                // A link of placed points rides as placed.
                let placed = self.joins[body].len() > 1 && self.dimensions[body] == Dimensions::None;
                if !placed && self.turned[index].abs() > 1e-12 {
                    let turned = self.angle(self.turned[index]);
                    said.insert("turned".into(), turned);
                }
            }
        }
        let from;
        let on = match slide.path {
            Path::Line { through, .. } => {
                let along = self.along(index).unwrap_or([1.0, 0.0]);
                let (guide, zero) = self.line(slide.on, through, along, slide.swivel, true);
                from = zero;
                guide
            }
            Path::Arc { centre, point, radius } => {
                let mut guide = Map::new();
                guide.insert("link".into(), json!(self.m.bodies[slide.on].number));
                let place = match point {
                    Some(point) if self.dice.chance(0.6) => json!(self.name(point)),
                    _ => {
                        let place = self.own[slide.on].of(centre);
                        self.place(place)
                    }
                };
                guide.insert("centre".into(), place);
                let radius = self.length(radius);
                guide.insert("radius".into(), radius);
                from = centre;
                guide
            }
        };
        said.insert("on".into(), Value::Object(on));
        (Value::Object(self.shuffled(said)), from)
    }

    fn shuffled(&mut self, map: Map<String, Value>) -> Map<String, Value> {
        if !self.wordy {
            return map;
        }
        let mut all: Vec<(String, Value)> = map.into_iter().collect();
        self.dice.shuffle(&mut all);
        all.into_iter().collect()
    }

    fn link(&mut self, body: usize) -> Value {
        let mut said = Map::new();
        let joins = self.joins[body].clone();
        let here: Vec<Place> = joins.iter().map(|p| self.m.at(*p)).collect();
        let names: Vec<&str> = joins.iter().map(|p| self.name(*p)).collect();
        said.insert("joins".into(), json!(names));
        let names: Vec<String> = names.iter().map(|n| (*n).to_owned()).collect();
        let apart = |a: usize, b: usize| length(minus(here[a], here[b]));
        let own = self.own[body];
        match self.dimensions[body] {
            Dimensions::None => {}
            Dimensions::Length => {
                let l = self.length(apart(0, 1));
                said.insert("length".into(), l);
            }
            Dimensions::Line => {
                let x = direction(own.angle);
                let all: Vec<Value> =
                    here.iter().map(|p| self.length(dot(x, minus(*p, own.origin)))).collect();
                said.insert("line".into(), json!(all));
            }
            Dimensions::Sides => {
                let all = [(0, 1), (1, 2), (2, 0)].map(|(a, b)| self.length(apart(a, b)));
                said.insert("sides".into(), json!(all));
                let ccw = cross(minus(here[1], here[0]), minus(here[2], here[0])) > 0.0;
                if !ccw || self.dice.chance(0.5) {
                    said.insert("turn".into(), json!(if ccw { "ccw" } else { "cw" }));
                }
            }
            Dimensions::Arms => {
                let (a, b) = (minus(here[1], here[0]), minus(here[2], here[0]));
                let all = [self.length(length(a)), self.length(length(b)), self.angle(angle(b) - angle(a))];
                said.insert("arms".into(), json!(all));
            }
            Dimensions::Shape => {
                let mut shape = Map::new();
                for (name, p) in names.into_iter().zip(&here) {
                    let place = own.of(*p);
                    shape.insert(name, self.place(place));
                }
                said.insert("shape".into(), Value::Object(self.shuffled(shape)));
            }
        }
        Value::Object(self.shuffled(said))
    }

    fn roll(&mut self, index: usize) -> Value {
        let roll = self.m.rolls[index];
        let mut said = Map::new();
        let [a, b] = roll.bodies.map(|b| self.m.bodies[b].number);
        let swap = self.dice.chance(0.4);
        said.insert("links".into(), if swap { json!([b, a]) } else { json!([a, b]) });
        match roll.contact {
            Contact::Wheels { centres, radii, internal } => {
                let [p, q] = centres.map(|p| self.name(p).to_owned());
                said.insert("centres".into(), if swap { json!([q, p]) } else { json!([p, q]) });
                if let Some((teeth, module)) = teeth(radii) {
                    let [z, y] = teeth;
                    said.insert("teeth".into(), if swap { json!([y, z]) } else { json!([z, y]) });
                    let module = self.length(module);
                    said.insert("module".into(), module);
                } else {
                    let [r, s] = radii.map(|r| self.length(r));
                    said.insert("radii".into(), if swap { json!([s, r]) } else { json!([r, s]) });
                }
                if internal || self.dice.chance(0.3) {
                    said.insert("internal".into(), json!(internal));
                }
            }
            Contact::Rack { through, along, centre, radius } => {
                let along = if self.dice.chance(0.5) { along } else { [-along[0], -along[1]] };
                let (line, _) = self.line(roll.bodies[0], through, along, false, false);
                said.insert("line".into(), Value::Object(line));
                said.insert("centre".into(), json!(self.name(centre)));
                let radius = self.length(radius);
                said.insert("radius".into(), radius);
            }
        }
        Value::Object(self.shuffled(said))
    }

    fn input(&mut self, index: usize, zeros: &[Place]) -> Value {
        let input = self.m.inputs[index];
        let mut said = Map::new();
        match input.driver {
            Driver::Link(body) => {
                said.insert("link".into(), json!(self.m.bodies[body].number));
                let joins = self.joins[body].clone();
                if joins.len() > 1 {
                    let free = self.stands(joins[0]) && self.stands(joins[1]);
                    if !free || self.dice.chance(0.3) {
                        let at = angle(minus(self.m.at(joins[1]), self.m.at(joins[0])));
                        let at = self.angle(at);
                        said.insert("angle".into(), at);
                    }
                }
                let swivels = self.m.slides.iter().any(|s| s.on == body && s.swivel);
                let rides = self.m.slides.iter().any(|s| s.rider == Rider::Link(body));
                // Of a link of one joint a place elsewhere may tell the direction; some place has to.
                let told = self.m.inputs.len() == 1 && self.placed.contains(&true);
                let untold = (swivels || rides) && !told;
                if joins.len() == 1 && (untold || swivels && self.dice.chance(0.5)) {
                    let at = self.angle(self.own[body].angle);
                    said.insert("angle".into(), at);
                }
                if joins.len() > 1 && self.m.is_fixed(joins[0]) && self.dice.chance(0.2) {
                    let to = self.dice.of(&joins[1..]);
                    let v = input.rate * length(minus(self.m.at(to), self.m.at(joins[0])));
                    let unit = format!("{}/{}", self.units.length.0, self.units.time.0);
                    let v = self.sensed(v, &unit);
                    said.insert("speed".into(), json!({ self.name(to): v }));
                } else if input.rate != 0.0 || self.dice.chance(0.5) {
                    let rate = self.turning(input.rate, 1);
                    said.insert("omega".into(), rate);
                }
                if input.second != 0.0 || self.dice.chance(0.3) {
                    let second = self.turning(input.second, 2);
                    said.insert("alpha".into(), second);
                }
            }
            Driver::Slide(slide) => {
                let pair = self.m.slides[slide];
                let (point, _) = self.m.rider(&pair);
                let once = self.m.slides.iter().filter(|s| self.m.rider(s).0 == point).count() == 1;
                let name = match pair.rider {
                    Rider::Pin { block: None, .. } => json!(self.name(point)),
                    Rider::Pin { block: Some(block), .. } => {
                        if once && self.dice.chance(0.6) {
                            json!(self.name(point))
                        } else {
                            json!(self.m.bodies[block].number)
                        }
                    }
                    Rider::Link(body) => json!(self.m.bodies[body].number),
                };
                said.insert("slide".into(), name);
                let Path::Line { along: truth, .. } = pair.path else { unreachable!("no arc is driven") };
                let along = self.along(slide).unwrap_or([1.0, 0.0]);
                let sense = dot(along, truth).signum();
                let free = self.stands(point) && self.all_stand(pair.on);
                if !free || self.dice.chance(0.3) {
                    let at = self.length(dot(along, minus(self.m.at(point), zeros[slide])));
                    said.insert("at".into(), at);
                }
                if input.rate != 0.0 || self.dice.chance(0.5) {
                    let v = self.running(sense * input.rate, 1);
                    said.insert("velocity".into(), v);
                }
                if input.second != 0.0 || self.dice.chance(0.3) {
                    let v = self.running(sense * input.second, 2);
                    said.insert("acceleration".into(), v);
                }
            }
        }
        Value::Object(self.shuffled(said))
    }
}

/// Numbers of teeth and a module for these radii, where few teeth will do.
fn teeth(radii: [f64; 2]) -> Option<([u32; 2], f64)> {
    (12..52).find_map(|z| {
        let other = f64::from(z) * radii[1] / radii[0];
        let whole = other.round();
        let fits = (other - whole).abs() < 1e-13 * other && (12.0..60.0).contains(&whole);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "12 to 60")]
        fits.then(|| ([z, whole as u32], 2.0 * radii[0] / f64::from(z)))
    })
}

/// What comes of dividing by a number of degrees is nearly whole more often than chance has it.
fn tidy(x: f64) -> f64 {
    if (x - x.round()).abs() < 1e-12 * (1.0 + x.abs()) { x.round() } else { x }
}

/// Says a mechanism.
pub(crate) fn say(m: &Mechanism, made: &[&'static str], condition: f64, dice: &mut Dice) -> Said {
    let units = Units {
        length: dice.of(&LENGTHS),
        angle: if dice.chance(0.7) { ANGLES[0] } else { dice.of(&ANGLES) },
        time: if dice.chance(0.8) { TIMES[0] } else { dice.of(&TIMES) },
    };
    let mut ways = Vec::new();
    let exotic = made.contains(&"led-by-wheels") || made.contains(&"driven-elsewhere") && !m.rolls.is_empty();
    let part = match dice.below(100) {
        _ if exotic => 1.0,
        0..40 => 1.0,
        40..70 => 0.0,
        _ => dice.between(0.1, 0.9),
    };
    ways.push(if part >= 1.0 {
        "all placed"
    } else if part <= 0.0 {
        "by dimensions"
    } else {
        "mixed"
    });
    let mut placed: Vec<bool> = (0..m.points.len()).map(|p| !m.is_fixed(p) && dice.chance(part)).collect();
    // How far a wheel has turned no dimension tells.
    for roll in &m.rolls {
        for body in roll.bodies {
            if body != FRAME && m.bodies[body].joins.len() > 1 {
                for p in &m.bodies[body].joins {
                    placed[*p] = !m.is_fixed(*p);
                }
            }
        }
    }
    let mut joins: Vec<Vec<usize>> = m.bodies.iter().map(|b| b.joins.clone()).collect();
    for (body, joins) in joins.iter_mut().enumerate() {
        let rides = m.slides.iter().any(|s| s.rider == Rider::Link(body));
        if joins.len() > 1 && dice.chance(0.3) {
            // A rider's first joint is on its guide.
            let from = usize::from(rides);
            dice.shuffle(&mut joins[from..]);
        }
    }
    let wordy = dice.chance(0.3);
    let mut w = Writer {
        m,
        units,
        placed,
        own: vec![Own::WORLD; m.bodies.len()],
        dimensions: vec![Dimensions::None; m.bodies.len()],
        joins,
        flipped: m.slides.iter().map(|_| dice.chance(0.4)).collect(),
        turned: vec![0.0; m.slides.len()],
        wordy,
        dice,
    };
    let links: Vec<usize> = (1..m.bodies.len()).filter(|b| m.bodies[*b].kind == Kind::Link).collect();
    for body in &links {
        if w.joins[*body].len() == 1 {
            w.own_of_one_joint(*body);
        } else {
            w.choose_dimensions(*body);
        }
    }
    let mut scene = Map::new();
    let names = [(units.length, "length", "m"), (units.angle, "angle", "deg"), (units.time, "time", "s")];
    let mut said_units = Map::new();
    for (unit, key, default) in names {
        if unit.0 != default || w.dice.chance(0.3) {
            said_units.insert(key.into(), json!(unit.0));
        }
    }
    if !said_units.is_empty() {
        scene.insert("units".into(), Value::Object(said_units));
    }
    let mut fixed = Map::new();
    let mut placed = Map::new();
    let mut near = Map::new();
    let size = m.size();
    // Next to a dead centre two assemblies lie close to each other: a rough place has to say which.
    let blur = (0.2 * condition).min(0.0005) * size;
    for (i, point) in m.points.iter().enumerate() {
        if m.is_fixed(i) {
            fixed.insert(point.name.clone(), w.place(point.at));
        } else if w.placed[i] {
            placed.insert(point.name.clone(), w.place(point.at));
        } else {
            let at = [0, 1].map(|k| {
                let x = point.at[k] + blur * w.dice.between(-1.0, 1.0);
                // As one writes them by eye.
                let step = 0.4 * blur;
                (x / step).round() * step
            });
            near.insert(point.name.clone(), json!(at));
        }
    }
    for (key, map) in [("fixed", fixed), ("placed", placed)] {
        if !map.is_empty() {
            let map = w.shuffled(map);
            scene.insert(key.into(), Value::Object(map));
        }
    }
    let mut order = links.clone();
    if w.dice.chance(0.4) {
        w.dice.shuffle(&mut order);
    }
    let said: Map<String, Value> =
        order.iter().map(|b| (m.bodies[*b].number.to_string(), w.link(*b))).collect();
    scene.insert("links".into(), Value::Object(said));
    let mut slides = Vec::new();
    let mut zeros = Vec::new();
    for i in 0..m.slides.len() {
        let (said, zero) = w.slide(i);
        slides.push(said);
        zeros.push(zero);
    }
    if !slides.is_empty() {
        if w.dice.chance(0.3) {
            w.dice.shuffle(&mut slides);
        }
        scene.insert("slides".into(), json!(slides));
    }
    if !m.rolls.is_empty() {
        let rolls: Vec<Value> = (0..m.rolls.len()).map(|i| w.roll(i)).collect();
        scene.insert("rolls".into(), json!(rolls));
    }
    if !near.is_empty() {
        let near = w.shuffled(near);
        scene.insert("near".into(), Value::Object(near));
    }
    let inputs: Vec<Value> = (0..m.inputs.len()).map(|i| w.input(i, &zeros)).collect();
    if let ([one], true) = (inputs.as_slice(), w.dice.chance(0.8)) {
        scene.insert("input".into(), one.clone());
    } else {
        scene.insert("inputs".into(), json!(inputs));
    }
    let mut journals = vec![None; m.points.len()];
    let mut pins = Map::new();
    for (i, point) in m.points.iter().enumerate() {
        if point.of.len() > 1 && w.dice.chance(0.4) {
            let radius = size * w.dice.between(0.001, 0.02);
            journals[i] = Some(radius);
            let said = if w.dice.chance(0.5) {
                json!({ "radius": w.length(radius) })
            } else {
                json!({ "diameter": w.length(2.0 * radius) })
            };
            pins.insert(point.name.clone(), said);
        }
    }
    if !pins.is_empty() {
        scene.insert("pins".into(), Value::Object(pins));
    }
    let scene = w.shuffled(scene);
    let of_one_joint = |body: usize| w.joins[body].len() == 1;
    let rides = |body: usize| m.slides.iter().any(|s| s.rider == Rider::Link(body));
    let swivels = |body: usize| m.slides.iter().any(|s| s.on == body && s.swivel);
    let is_link = |body: usize| m.bodies[body].kind == Kind::Link;
    let as_placed = |slide: &Slide| match slide.rider {
        Rider::Link(body) => !of_one_joint(body) && w.dimensions[body] == Dimensions::None,
        Rider::Pin { .. } => false,
    };
    let told = Told {
        joins: w.joins.clone(),
        stands: (0..m.points.len()).map(|p| w.stands(p)).collect(),
        as_placed: m.slides.iter().map(as_placed).collect(),
        inputs: inputs.iter().map(|said| said.get("angle").or(said.get("at")).is_some()).collect(),
        upright: (0..m.bodies.len())
            .map(|b| is_link(b) && of_one_joint(b) && !rides(b) && !swivels(b))
            .collect(),
    };
    Said { scene: Value::Object(scene), units, own: w.own, journals, ways, told }
}
