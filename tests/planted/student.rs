//! A student with compasses, ruler and calculator: the mechanism is solved group by group from the vector equations
//! of its links, each line drawn and met with the other, each reading divided by the length it belongs to. At any of
//! these steps he can make a mistake; all that follows is then done rightly with the wrong number.
//!
//! This is the test's own kinematics. It shares nothing with linkgram.

use std::collections::BTreeMap;

use super::mechanism::{Group, Mechanism, Unit};
use super::mistakes::{Kind, Mistake};
use super::plane::{Chance, O, Xy, corner, meet, xy};

/// How far a pricked point may miss, in mm on paper.
const PENCIL: f64 = 0.2;
/// How much too long, and how far off (17°), the mistakes are that nobody foresees.
const TOO_LONG: f64 = 1.37;
const TURNED: f64 = 17.0;

/// Which diagram.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Diagram {
    Velocity,
    Acceleration,
}

/// Real units per mm on paper of the three figures.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Scales {
    pub(crate) length: f64,
    pub(crate) velocity: f64,
    pub(crate) acceleration: f64,
}

impl Scales {
    fn of(&self, diagram: Diagram) -> f64 {
        match diagram {
            Diagram::Velocity => self.velocity,
            Diagram::Acceleration => self.acceleration,
        }
    }
}

/// A vector of a diagram.
#[derive(Debug, Clone)]
pub(crate) struct Reading {
    pub(crate) name: String,
    pub(crate) diagram: Diagram,
    /// As it stands on the drawing, in real units.
    pub(crate) drawn: Xy,
    /// As the student writes it down.
    pub(crate) value: Xy,
}

/// An angular velocity or acceleration.
#[derive(Debug, Clone)]
pub(crate) struct Turning {
    pub(crate) name: String,
    /// Counter-clockwise positive.
    pub(crate) value: f64,
    /// Its sense can be told from the drawing.
    pub(crate) sense: bool,
}

/// Why the student cannot go on.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stuck;

/// Another link of the same group, whose numbers may be taken by mistake.
#[derive(Clone, Copy)]
struct Neighbour {
    toward: Option<Xy>,
    omega: Option<f64>,
    length: Option<f64>,
    /// Size of its own normal part.
    normal: Option<f64>,
}

/// Everything that the student has found.
#[derive(Debug)]
pub(crate) struct Student<'a> {
    mechanism: &'a Mechanism,
    planted: &'a [Mistake],
    pencil: Option<Chance>,
    pub(crate) scales: Scales,
    /// Every mistake that could have been made.
    pub(crate) offered: Vec<Mistake>,
    /// Moving points in the order in which they were found.
    pub(crate) places: Vec<(String, Xy)>,
    /// Image points of both diagrams, poles left out.
    pub(crate) velocity: Vec<(String, Xy)>,
    pub(crate) acceleration: Vec<(String, Xy)>,
    pub(crate) readings: Vec<Reading>,
    pub(crate) turnings: Vec<Turning>,
    lengths: BTreeMap<&'static str, f64>,
}

/// Solves the mechanism, with these mistakes or none, with a slipping pencil or none.
pub(crate) fn solve<'a>(
    mechanism: &'a Mechanism,
    planted: &'a [Mistake],
    pencil: Option<Chance>,
    scales: Scales,
) -> Result<Student<'a>, Stuck> {
    let mut student = Student {
        mechanism,
        planted,
        pencil,
        scales,
        offered: Vec::new(),
        places: Vec::new(),
        velocity: Vec::new(),
        acceleration: Vec::new(),
        readings: Vec::new(),
        turnings: Vec::new(),
        lengths: BTreeMap::new(),
    };
    student.positions()?;
    student.velocities()?;
    student.accelerations()?;
    Ok(student)
}

fn lower(point: &str) -> String {
    point.to_lowercase()
}

impl Student<'_> {
    /// Offers a mistake; true where it is to be made.
    fn slips(&mut self, kind: Kind, at: &str, how: &'static str) -> bool {
        let mistake = Mistake { kind, at: at.to_owned(), how };
        let made = self.planted.contains(&mistake);
        if !self.offered.contains(&mistake) {
            self.offered.push(mistake);
        }
        made
    }

    fn prick(&mut self, at: Xy, per_mm: f64) -> Xy {
        self.pencil.as_mut().map_or(at, |pencil| at + pencil.disc(PENCIL * per_mm))
    }

    pub(crate) fn place(&self, point: &str) -> Xy {
        let found = self.places.iter().find(|(n, _)| n == point).map(|(_, p)| *p);
        found.unwrap_or_else(|| self.mechanism.fixed(point))
    }

    fn images(&mut self, diagram: Diagram) -> &mut Vec<(String, Xy)> {
        match diagram {
            Diagram::Velocity => &mut self.velocity,
            Diagram::Acceleration => &mut self.acceleration,
        }
    }

    /// Image of a point; fixed points lie in the pole.
    fn image(&mut self, diagram: Diagram, point: &str) -> Xy {
        let name = lower(point);
        let with_link = format!("{name}2");
        let found = self.images(diagram).iter().find(|(n, _)| *n == name || *n == with_link);
        found.map_or(O, |(_, p)| *p)
    }

    /// Pricks and names an image point.
    fn mark(&mut self, diagram: Diagram, name: &str, at: Xy) -> Xy {
        let at = self.prick(at, self.scales.of(diagram));
        self.images(diagram).push((name.to_owned(), at));
        at
    }

    fn pin(&mut self, name: &str, at: Xy) {
        let at = self.prick(at, self.scales.length);
        self.places.push((name.to_owned(), at));
    }

    /// A length of the question as it enters a calculation at `at`.
    fn length(&mut self, link: &'static str, given: f64) -> f64 {
        let (kind, factor) = match self.mechanism.unit {
            Unit::Cm => (Kind::CmAsMm, 0.1),
            Unit::Mm => (Kind::CmAsMm, 10.0),
            Unit::Inch => (Kind::InchAsFoot, 12.0),
            Unit::Foot => (Kind::InchAsFoot, 1.0 / 12.0),
        };
        if matches!(self.mechanism.unit, Unit::Cm | Unit::Mm)
            && self.slips(Kind::MetreMixed, "lengths", "all")
        {
            self.lengths.insert(link, given);
            return given * if self.mechanism.unit == Unit::Cm { 0.01 } else { 0.001 };
        }
        let all = self.slips(kind, "lengths", "all");
        let one = self.slips(kind, &format!("length({link})"), "one");
        self.lengths.insert(link, given);
        if all || one { given * factor } else { given }
    }

    /// What a misused scale makes of a reading.
    fn scale_slip(&mut self, name: &str, diagram: Diagram) -> f64 {
        let per_mm = self.scales.of(diagram);
        let every = match diagram {
            Diagram::Velocity => "velocities",
            Diagram::Acceleration => "accelerations",
        };
        let mut factor = 1.0;
        for (how, times) in [("twice", 2.0), ("half", 0.5), ("mm for cm", 10.0), ("cm for mm", 0.1)] {
            if self.slips(Kind::ScaleWrong, every, how) {
                factor = times;
            }
        }
        for at in [name, every] {
            if self.slips(Kind::ScaleForgotten, at, "mm") {
                factor = 1.0 / per_mm;
            }
            if self.slips(Kind::ScaleForgotten, at, "cm") {
                factor = 0.1 / per_mm;
            }
            if self.slips(Kind::ScaleInverted, at, "mm") {
                factor = 1.0 / per_mm / per_mm;
            }
            if self.slips(Kind::ScaleInverted, at, "cm") {
                factor = 0.01 / per_mm / per_mm;
            }
        }
        factor
    }

    /// Reads a vector off the diagram.
    fn read(&mut self, name: &str, diagram: Diagram, from: Xy, to: Xy, wrong_pole: Option<Xy>) -> Xy {
        let mut drawn = to - from;
        if let Some(pole) = wrong_pole.filter(|p| (*p - from).size() > 0.0)
            && self.slips(Kind::WrongPole, name, "")
        {
            drawn = to - pole;
        }
        let scale = self.scales.of(diagram);
        let far = |p: &Xy| (*p - to).size() > 3.0 * scale && (*p - from).size() > 3.0 * scale;
        let neighbour = self.images(diagram).iter().rev().map(|(_, p)| *p).find(far);
        if let Some(neighbour) = neighbour
            && self.slips(Kind::NeighbourRead, name, "head")
        {
            drawn = neighbour - from;
        }
        if name.contains('/') && self.slips(Kind::RelativeReversed, name, "read") {
            drawn = -drawn;
        }
        let mut value = drawn * self.scale_slip(name, diagram);
        if self.slips(Kind::Unforeseen, name, "read too long") {
            value = value * TOO_LONG;
        }
        self.readings.push(Reading { name: name.to_owned(), diagram, drawn, value });
        value
    }

    /// Notes a vector that was computed and then drawn.
    fn laid_off(&mut self, name: &str, diagram: Diagram, drawn: Xy, value: Xy) {
        self.readings.push(Reading { name: name.to_owned(), diagram, drawn, value });
    }

    /// ω or α from a vector across an arm.
    fn turning(&mut self, name: &str, vector: Xy, arm: Xy, length: f64) -> f64 {
        let moment = arm.unit().cross(vector);
        // A vector that was drawn along the link turns it neither way.
        let sense = moment.abs() > 0.15 * vector.size();
        let mut value = vector.size() / length;
        if sense && moment < 0.0 {
            value = -value;
        }
        if self.slips(Kind::SenseReversed, name, "") {
            value = -value;
        }
        self.turnings.push(Turning { name: name.to_owned(), value, sense });
        value
    }

    fn omega(&self, link: &str) -> f64 {
        let name = format!("omega({link})");
        self.turnings.iter().find(|t| t.name == name).map_or_else(|| self.crank_omega(), |t| t.value)
    }

    /// ω of the crank as this student took it.
    fn crank_omega(&self) -> f64 {
        let m = self.mechanism;
        let is = |kind| self.planted.iter().any(|p| p.kind == kind && p.at == "omega(2)");
        let turn = std::f64::consts::TAU;
        let w = match m.rpm {
            true if is(Kind::RpmAsRad) => m.omega,
            true if is(Kind::RevAsRad) => m.omega / 60.0,
            true => m.omega * turn / 60.0,
            false if is(Kind::RadAsRpm) => m.omega * turn / 60.0,
            false => m.omega,
        };
        if is(Kind::SenseReversed) { -w } else { w }
    }

    /// A line of the diagram: across a link where it is said so, along it otherwise.
    fn line(&mut self, name: &str, along: Xy, across: bool) -> Xy {
        let mut direction = if across { along.left() } else { along };
        if self.slips(Kind::PerpendicularForParallel, name, "") {
            direction = direction.left();
        }
        // The crank's direction, where it is clear of the right one.
        let crank = self.place("A").unit();
        let clear = crank.cross(along.unit()).abs() > 0.3 && crank.dot(along.unit()).abs() > 0.3;
        if clear && !name.contains('@') && self.slips(Kind::WrongLine, name, "by the crank") {
            direction = if across { crank.left() } else { crank };
        }
        if self.slips(Kind::Unforeseen, name, "line turned") {
            direction = direction.turned(TURNED.to_radians());
        }
        direction
    }

    /// Normal part v²/l toward the centre.
    fn normal(&mut self, name: &str, toward: Xy, v: f64, length: f64, other: Neighbour) -> Xy {
        let mut size = v * v / length;
        let mut direction = toward.unit();
        if let Some(other) = other.toward
            && self.slips(Kind::NormalOfWrongLink, name, "direction")
        {
            direction = other.unit();
        }
        if let Some(omega) = other.omega
            && self.slips(Kind::NormalOfWrongLink, name, "omega")
        {
            size = omega * omega * length;
        }
        if let Some(other) = other.length
            && self.slips(Kind::NormalOfWrongLink, name, "length")
        {
            size = v * v / other;
        }
        if let Some(other) = other.normal
            && self.slips(Kind::NormalOfWrongLink, name, "value")
        {
            size = other;
        }
        if self.slips(Kind::NormalAwayFromCentre, name, "") {
            direction = -direction;
        }
        if self.slips(Kind::Unforeseen, name, "too long") {
            size *= TOO_LONG;
        }
        if self.slips(Kind::Unforeseen, name, "turned") {
            direction = direction.turned(TURNED.to_radians());
        }
        direction * size
    }

    fn positions(&mut self) -> Result<(), Stuck> {
        let m = self.mechanism;
        let angle = match self.slips(Kind::CalculatorInRadians, "angle(2)", "given") {
            true => m.angle.to_degrees(),
            false => m.angle,
        };
        self.pin("A", Xy::polar(m.crank, angle));
        for group in &m.groups {
            match *group {
                Group::Dyad { from, coupler_length, pivot, rocker_length, pin, side, .. } => {
                    let other = self.slips(Kind::WrongAssembly, pin, "");
                    let side = if other { -side } else { side };
                    let at = corner(self.place(from), self.place(pivot), coupler_length, rocker_length, side);
                    self.pin(pin, at.ok_or(Stuck)?);
                }
                Group::Further { first, second, point, shape, .. } => {
                    let base = self.place(first);
                    self.pin(point, base + (self.place(second) - base).times(shape));
                }
                Group::Slider { from, length, pin, through, angle, side, .. } => {
                    let other = self.slips(Kind::WrongAssembly, pin, "");
                    let side = if other { -side } else { side };
                    let along = Xy::polar(1.0, angle);
                    let to = self.place(from) - through;
                    let square = length * length - along.cross(to) * along.cross(to);
                    if square <= 0.0 {
                        return Err(Stuck);
                    }
                    self.pin(pin, through + along * (along.dot(to) + side * square.sqrt()));
                }
                Group::Lever { pin, pivot, end, length, side, .. } => {
                    let base = self.place(pivot);
                    self.pin(end, base + (self.place(pin) - base).unit() * (length * side));
                }
                Group::Cylinder { pin, pivot, end, length, .. } => {
                    let base = self.place(pin);
                    self.pin(end, base + (self.place(pivot) - base).unit() * length);
                }
            }
        }
        Ok(())
    }

    fn velocities(&mut self) -> Result<(), Stuck> {
        use Diagram::Velocity;
        let m = self.mechanism;
        if m.rpm {
            self.slips(Kind::RpmAsRad, "omega(2)", "");
            self.slips(Kind::RevAsRad, "omega(2)", "");
        } else {
            self.slips(Kind::RadAsRpm, "omega(2)", "");
        }
        // How vectors are written down is seen by whoever writes them.
        for how in ["written", "typed"] {
            self.slips(Kind::CalculatorInRadians, "directions", how);
        }
        self.slips(Kind::SenseReversed, "omega(2)", "");
        let omega = self.crank_omega();
        let arm = self.place("A");
        let radius = self.length("2", m.crank);
        let mut across = arm.unit().left();
        if self.slips(Kind::PerpendicularForParallel, "v(A)", "") {
            across = arm.unit();
        }
        let coincident = matches!(m.groups[0], Group::Lever { .. });
        let mut a = across * (omega * radius);
        if self.slips(Kind::Unforeseen, "v(A)", "too long") {
            a = a * TOO_LONG;
        }
        if self.slips(Kind::Unforeseen, "v(A)", "turned") {
            a = a.turned(TURNED.to_radians());
        }
        self.laid_off("v(A)", Velocity, a, a);
        self.mark(Velocity, if coincident { "a2" } else { "a" }, a);
        for group in &m.groups {
            match *group {
                Group::Dyad { coupler, from, coupler_length, rocker, pivot, rocker_length, pin, .. } => {
                    let (f, p, o) = (self.place(from), self.place(pin), self.place(pivot));
                    let start = self.image(Velocity, from);
                    let relative = format!("v({pin}/{from})");
                    let absolute = format!("v({pin})");
                    let d = self.line(&relative, p - f, true);
                    let e = self.line(&absolute, p - o, true);
                    let at = meet(start, d, O, e).ok_or(Stuck)?;
                    let at = self.mark(Velocity, &lower(pin), at);
                    let relative = self.read(&relative, Velocity, start, at, None);
                    let absolute = self.read(&absolute, Velocity, O, at, Some(start));
                    let length = self.length(coupler, coupler_length);
                    self.turning(&format!("omega({coupler})"), relative, p - f, length);
                    let length = self.length(rocker, rocker_length);
                    self.turning(&format!("omega({rocker})"), absolute, p - o, length);
                }
                Group::Further { .. } => self.further(Velocity, group),
                Group::Slider { rod, from, length, pin, angle, .. } => {
                    let (f, p) = (self.place(from), self.place(pin));
                    let start = self.image(Velocity, from);
                    let relative = format!("v({pin}/{from})");
                    let absolute = format!("v({pin})");
                    let d = self.line(&relative, p - f, true);
                    let e = self.line(&absolute, Xy::polar(1.0, angle), false);
                    let at = meet(start, d, O, e).ok_or(Stuck)?;
                    let at = self.mark(Velocity, &lower(pin), at);
                    let relative = self.read(&relative, Velocity, start, at, None);
                    self.read(&absolute, Velocity, O, at, Some(start));
                    let length = self.length(rod, length);
                    self.turning(&format!("omega({rod})"), relative, p - f, length);
                }
                Group::Lever { pin, lever, pivot, end, length, .. } => {
                    let omega = self.slot_velocity(pin, lever, pivot);
                    let arm = self.place(end) - self.place(pivot);
                    let length = self.length("end", length);
                    let mut at = if m.by_image {
                        let under = self.image(Velocity, &format!("{pin}4"));
                        let whole = self.place(pin) - self.place(pivot);
                        under * (arm.dot(whole.unit()) / whole.size())
                    } else {
                        arm.unit().left() * (omega * length)
                    };
                    if self.slips(Kind::SenseReversed, &format!("v({end})"), "") {
                        at = -at;
                    }
                    let at = self.mark(Velocity, &lower(end), at);
                    let under = self.image(Velocity, &format!("{pin}4"));
                    self.read(&format!("v({end})"), Velocity, O, at, Some(under));
                }
                Group::Cylinder { pin, swivel, pivot, end, length, .. } => {
                    let omega = self.slot_velocity(pin, swivel, pivot);
                    let start = self.image(Velocity, pin);
                    let arm = self.place(end) - self.place(pin);
                    let length = self.length("end", length);
                    let mut relative = arm.unit().left() * (omega * length);
                    if self.slips(Kind::RelativeReversed, &format!("v({end}/{pin})"), "laid off") {
                        relative = -relative;
                    }
                    let at = self.mark(Velocity, &lower(end), start + relative);
                    self.laid_off(&format!("v({end}/{pin})"), Velocity, at - start, relative);
                    self.read(&format!("v({end})"), Velocity, O, at, Some(start));
                }
            }
        }
        Ok(())
    }

    /// Velocity of a pin on a guide that turns about a fixed pivot; ω of the guide.
    fn slot_velocity(&mut self, pin: &str, guide: &'static str, pivot: &str) -> f64 {
        use Diagram::Velocity;
        let arm = self.place(pin) - self.place(pivot);
        let a = self.image(Velocity, pin);
        // Foot of the square from a to the line across the guide through the pole. Both parts are square to each
        // other: whoever swaps ∥ and ⊥ swaps them for both.
        let mut across = arm.unit().left();
        if self.slips(Kind::PerpendicularForParallel, &format!("slip({pin}/4)"), "") {
            across = arm.unit();
        }
        let foot = across * across.dot(a);
        let under = self.mark(Velocity, &format!("{}4", lower(pin)), foot);
        self.read(&format!("slip({pin}/4)"), Velocity, under, a, None);
        let v = self.read(&format!("v({pin}@4)"), Velocity, O, under, None);
        let length = self.length("guide", arm.size());
        self.turning(&format!("omega({guide})"), v, arm, length)
    }

    /// A further point of a link by the image of the link.
    fn further(&mut self, diagram: Diagram, group: &Group) {
        let Group::Further { first, second, point, shape, .. } = *group else { return };
        let (letter, both) = match diagram {
            Diagram::Velocity => ("v", "images"),
            Diagram::Acceleration => ("a", "images"),
        };
        let name = format!("{letter}({point})");
        let base = self.image(diagram, first);
        let tip = self.image(diagram, second);
        let mut figure = shape;
        if shape.unit().y.abs() > 0.1
            && (self.slips(Kind::ImageMirrored, &name, "") | self.slips(Kind::ImageMirrored, both, ""))
        {
            figure = figure.mirrored();
        }
        let pivoted = self.mechanism.fixed.iter().any(|(n, _)| *n == first);
        if pivoted {
            if self.slips(Kind::SenseReversed, &name, "") {
                figure = -figure;
            }
            if self.slips(Kind::TangentialWrongLength, &name, "to the other pin") {
                figure = figure * ((shape - xy(1.0, 0.0)).size() / shape.size());
            }
        } else if self.slips(Kind::RelativeReversed, &name, "laid off") {
            figure = -figure;
        }
        if self.slips(Kind::Unforeseen, &name, "image too long") {
            figure = figure * TOO_LONG;
        }
        let at = self.mark(diagram, &lower(point), base + (tip - base).times(figure));
        self.read(&name, diagram, O, at, Some(if pivoted { tip } else { base }));
    }

    fn accelerations(&mut self) -> Result<(), Stuck> {
        use Diagram::Acceleration;
        let m = self.mechanism;
        let omega = self.crank_omega();
        let arm = self.place("A");
        let radius = self.length("2", m.crank);
        let other = m.groups.iter().find_map(|g| match g {
            Group::Dyad { coupler_length, .. } => Some(*coupler_length),
            Group::Slider { length, .. } | Group::Lever { length, .. } | Group::Cylinder { length, .. } => {
                Some(*length)
            }
            Group::Further { .. } => None,
        });
        let neighbour = Neighbour { toward: None, omega: None, length: other, normal: None };
        let normal = self.normal("an(A)", -arm, omega * radius, radius, neighbour);
        let mut a = normal;
        self.laid_off("an(A)", Acceleration, normal, normal);
        if m.alpha != 0.0 {
            let mut alpha = m.alpha;
            if self.slips(Kind::AlphaIgnored, "alpha(2)", "") {
                alpha = 0.0;
            }
            if self.slips(Kind::AlphaSign, "alpha(2)", "") {
                alpha = -alpha;
            }
            let mut radius = radius;
            if self.slips(Kind::TangentialWrongLength, "at(A)", "") {
                radius = other.ok_or(Stuck)?;
            }
            let across = self.line("at(A)", arm.unit(), true);
            let tangential = across * (alpha * radius);
            if alpha != 0.0 {
                self.laid_off("at(A)", Acceleration, tangential, tangential);
            }
            a = a + tangential;
        }
        let coincident = matches!(m.groups[0], Group::Lever { .. });
        let a = self.mark(Acceleration, if coincident { "a2" } else { "a" }, a);
        self.laid_off("a(A)", Acceleration, a, a);
        let mut before = "2";
        for group in &m.groups {
            match *group {
                Group::Dyad { coupler, from, coupler_length, rocker, pivot, rocker_length, pin, .. } => {
                    self.dyad_acceleration(
                        (coupler, from, coupler_length),
                        (rocker, pivot, rocker_length),
                        pin,
                    )?;
                    before = rocker;
                }
                Group::Further { .. } => self.further(Acceleration, group),
                Group::Slider { rod, from, length, pin, angle, .. } => {
                    let (f, p) = (self.place(from), self.place(pin));
                    let start = self.image(Acceleration, from);
                    let v = self.value(&format!("v({pin}/{from})")).size();
                    let length = self.length(rod, length);
                    let neighbour = Neighbour {
                        toward: Some(-self.arm_of(before)),
                        omega: Some(self.omega(before)),
                        length: self.lengths.get(before).copied(),
                        normal: self.lengths.get(before).map(|l| l * self.omega(before) * self.omega(before)),
                    };
                    let name = format!("an({pin}/{from})");
                    let normal = self.normal(&name, f - p, v, length, neighbour);
                    let foot = self.prick(start + normal, self.scales.acceleration);
                    self.laid_off(&name, Acceleration, foot - start, normal);
                    let tangential = format!("at({pin}/{from})");
                    let d = self.line(&tangential, p - f, true);
                    let e = self.line(&format!("a({pin})"), Xy::polar(1.0, angle), false);
                    let at = meet(foot, d, O, e).ok_or(Stuck)?;
                    let at = self.mark(Acceleration, &lower(pin), at);
                    let tangential = self.read(&tangential, Acceleration, foot, at, None);
                    self.read(&format!("a({pin})"), Acceleration, O, at, Some(start));
                    self.read(&format!("a({pin}/{from})"), Acceleration, start, at, None);
                    let wrong = self.lengths.get(before).copied().unwrap_or(m.crank);
                    self.alpha(rod, tangential, p - f, length, wrong);
                }
                Group::Lever { pin, lever, pivot, end, length, .. } => {
                    let alpha = self.slot_acceleration(pin, lever, pivot, length)?;
                    let omega = self.omega(lever);
                    let whole = self.place(pin) - self.place(pivot);
                    let arm = self.place(end) - self.place(pivot);
                    let length = self.length("end", length);
                    let at = if m.by_image {
                        let under = self.image(Acceleration, &format!("{pin}4"));
                        under * (arm.dot(whole.unit()) / whole.size())
                    } else {
                        let neighbour =
                            Neighbour { toward: None, omega: None, length: Some(whole.size()), normal: None };
                        let name = format!("an({end})");
                        let normal = self.normal(&name, -arm, omega * length, length, neighbour);
                        self.laid_off(&name, Acceleration, normal, normal);
                        let name = format!("at({end})");
                        let wrong = self.slips(Kind::TangentialWrongLength, &name, "");
                        let radius = if wrong { whole.size() } else { length };
                        let tangential = arm.unit().left() * (alpha * radius);
                        self.laid_off(&name, Acceleration, tangential, tangential);
                        normal + tangential
                    };
                    let at = self.mark(Acceleration, &lower(end), at);
                    let under = self.image(Acceleration, &format!("{pin}4"));
                    self.read(&format!("a({end})"), Acceleration, O, at, Some(under));
                    before = lever;
                }
                Group::Cylinder { pin, swivel, pivot, end, length, .. } => {
                    let alpha = self.slot_acceleration(pin, swivel, pivot, length)?;
                    let omega = self.omega(swivel);
                    let start = self.image(Acceleration, pin);
                    let whole = (self.place(pin) - self.place(pivot)).size();
                    let arm = self.place(end) - self.place(pin);
                    let length = self.length("end", length);
                    let neighbour =
                        Neighbour { toward: None, omega: None, length: Some(whole), normal: None };
                    let name = format!("an({end}/{pin})");
                    let normal = self.normal(&name, -arm, omega * length, length, neighbour);
                    self.laid_off(&name, Acceleration, normal, normal);
                    let name = format!("at({end}/{pin})");
                    let wrong = self.slips(Kind::TangentialWrongLength, &name, "");
                    let tangential = arm.unit().left() * (alpha * if wrong { whole } else { length });
                    self.laid_off(&name, Acceleration, tangential, tangential);
                    let at = self.mark(Acceleration, &lower(end), start + normal + tangential);
                    self.read(&format!("a({end})"), Acceleration, O, at, Some(start));
                }
            }
        }
        Ok(())
    }

    fn value(&self, name: &str) -> Xy {
        self.readings.iter().find(|r| r.name == name).unwrap().value
    }

    /// From the fixed pivot of a link to its pin.
    fn arm_of(&self, link: &str) -> Xy {
        for group in &self.mechanism.groups {
            match *group {
                Group::Dyad { rocker, pivot, pin, .. } if rocker == link => {
                    return self.place(pin) - self.place(pivot);
                }
                Group::Lever { lever, pivot, end, .. } if lever == link => {
                    return self.place(end) - self.place(pivot);
                }
                _ => {}
            }
        }
        self.place("A")
    }

    fn alpha(&mut self, link: &str, tangential: Xy, arm: Xy, length: f64, wrong: f64) -> f64 {
        let name = format!("alpha({link})");
        let slip = self.slips(Kind::TangentialWrongLength, &name, "");
        self.turning(&name, tangential, arm, if slip { wrong } else { length })
    }

    fn dyad_acceleration(
        &mut self,
        (coupler, from, coupler_length): (&'static str, &str, f64),
        (rocker, pivot, rocker_length): (&'static str, &str, f64),
        pin: &str,
    ) -> Result<(), Stuck> {
        use Diagram::Acceleration;
        let (f, p, o) = (self.place(from), self.place(pin), self.place(pivot));
        let start = self.image(Acceleration, from);
        let (l3, l4) = (self.length(coupler, coupler_length), self.length(rocker, rocker_length));
        let v3 = self.value(&format!("v({pin}/{from})")).size();
        let v4 = self.value(&format!("v({pin})")).size();
        let side = |toward, omega: f64, length: f64| Neighbour {
            toward: Some(toward),
            omega: Some(omega),
            length: Some(length),
            normal: Some(omega * omega * length),
        };
        let rocker_side = side(o - p, self.omega(rocker), rocker_length);
        let coupler_side = side(f - p, self.omega(coupler), coupler_length);
        let names = [format!("an({pin}/{from})"), format!("an({pin})")];
        let n3 = self.normal(&names[0], f - p, v3, l3, rocker_side);
        let n4 = self.normal(&names[1], o - p, v4, l4, coupler_side);
        let foot3 = self.prick(start + n3, self.scales.acceleration);
        let foot4 = self.prick(n4, self.scales.acceleration);
        self.laid_off(&names[0], Acceleration, foot3 - start, n3);
        self.laid_off(&names[1], Acceleration, foot4, n4);
        let names = [format!("at({pin}/{from})"), format!("at({pin})")];
        let d = self.line(&names[0], p - f, true);
        let e = self.line(&names[1], p - o, true);
        let at = meet(foot3, d, foot4, e).ok_or(Stuck)?;
        let at = self.mark(Acceleration, &lower(pin), at);
        let t3 = self.read(&names[0], Acceleration, foot3, at, None);
        let t4 = self.read(&names[1], Acceleration, foot4, at, None);
        self.read(&format!("a({pin})"), Acceleration, O, at, Some(start));
        self.read(&format!("a({pin}/{from})"), Acceleration, start, at, None);
        self.alpha(coupler, t3, p - f, l3, rocker_length);
        self.alpha(rocker, t4, p - o, l4, coupler_length);
        Ok(())
    }

    /// The equation with the Coriolis term; α of the guide.
    fn slot_acceleration(
        &mut self,
        pin: &str,
        guide: &'static str,
        pivot: &str,
        other_length: f64,
    ) -> Result<f64, Stuck> {
        use Diagram::Acceleration;
        let arm = self.place(pin) - self.place(pivot);
        let a = self.image(Acceleration, pin);
        let length = self.length("guide", arm.size());
        let v = self.value(&format!("v({pin}@4)")).size();
        let slip = self.value(&format!("slip({pin}/4)"));
        let omega = self.omega(guide);
        let crank = self.crank_omega();
        let neighbour = Neighbour {
            toward: None,
            omega: Some(crank),
            length: Some(other_length),
            normal: Some(crank * crank * self.mechanism.crank),
        };
        let name = format!("an({pin}@4)");
        let normal = self.normal(&name, -arm, v, length, neighbour);
        let foot = self.prick(normal, self.scales.acceleration);
        self.laid_off(&name, Acceleration, foot, normal);
        let name = format!("coriolis({pin}/4)");
        let missing = self.slips(Kind::CoriolisMissing, &name, "");
        let mut coriolis = slip.left() * (2.0 * omega);
        if missing {
            coriolis = O;
        }
        if self.slips(Kind::CoriolisWithoutTwo, &name, "") {
            coriolis = slip.left() * omega;
        }
        if self.slips(Kind::CoriolisWrongOmega, &name, "") {
            coriolis = slip.left() * (2.0 * crank);
        }
        if self.slips(Kind::CoriolisWrongTurn, &name, "") {
            coriolis = -coriolis;
        }
        if self.slips(Kind::Unforeseen, &name, "too long") {
            coriolis = coriolis * TOO_LONG;
        }
        let tail = if missing { a } else { self.prick(a - coriolis, self.scales.acceleration) };
        if !missing {
            self.laid_off(&name, Acceleration, a - tail, coriolis);
        }
        let name = format!("at({pin}@4)");
        let d = self.line(&format!("a({pin}@4)"), arm, true);
        let at = meet(foot, d, tail, d.left()).ok_or(Stuck)?;
        let at = self.mark(Acceleration, &format!("{}4", lower(pin)), at);
        let tangential = self.read(&name, Acceleration, foot, at, None);
        self.read(&format!("aslip({pin}/4)"), Acceleration, at, tail, None);
        self.read(&format!("a({pin}@4)"), Acceleration, O, at, None);
        Ok(self.alpha(guide, tangential, arm, length, other_length))
    }
}

impl Student<'_> {
    /// Whether a pencil makes something of it: lines cross at 27° or more, no guide's pin near its pivot, no vector
    /// of the velocity diagram, by which others are computed, below some millimetres.
    pub(crate) fn clear_of_dead_centres(&self) -> bool {
        let steep = |a: Xy, b: Xy| a.unit().cross(b.unit()).abs() > 0.45;
        let crossings = self.mechanism.groups.iter().all(|group| match *group {
            Group::Dyad { from, pivot, pin, .. } => {
                steep(self.place(pin) - self.place(from), self.place(pin) - self.place(pivot))
            }
            Group::Slider { from, pin, angle, .. } => {
                steep((self.place(pin) - self.place(from)).left(), Xy::polar(1.0, angle))
            }
            Group::Lever { pin, pivot, .. } | Group::Cylinder { pin, pivot, .. } => {
                let crank = self.mechanism.crank;
                (self.place(pin) - self.place(pivot)).size() > 0.5 * crank
            }
            Group::Further { .. } => true,
        });
        let legible = self
            .readings
            .iter()
            .filter(|r| r.diagram == Diagram::Velocity)
            .all(|r| r.drawn.size() > 8.0 * self.scales.velocity);
        let ends = self.mechanism.groups.iter().all(|group| match *group {
            Group::Cylinder { pin, pivot, end, .. } | Group::Lever { pin, pivot, end, .. } => {
                let crank = self.mechanism.crank;
                let end = self.place(end);
                (end - self.place(pin)).size() > 0.4 * crank && (end - self.place(pivot)).size() > 0.2 * crank
            }
            _ => true,
        });
        crossings && legible && ends
    }
}
