//! The mechanism while it is being read: names to indices, and where everything stands in the file.

use std::collections::HashMap;

use super::diagnostic::{Fault, Res};
use super::json::{MOST, Value};
use super::source::Anchors;
use super::units::Scales;
use super::{Gears, InputUnits};
use crate::mechanism::force::Forces;
use crate::mechanism::quantity::Unit;
use crate::mechanism::{
    Form, Given, GivenPoint, Guide, Input, Link, LinkId, Mechanism, Path, Place, Point, PointId, Rider,
};

/// The mechanism under construction.
pub(super) struct Draft<'s> {
    pub(super) scales: &'s Scales,
    pub(super) mechanism: Mechanism,
    pub(super) anchors: Anchors,
    pub(super) input_units: Vec<InputUnits>,
    /// The teeth of each rolling pair, where they stand for its radii.
    pub(super) gears: Vec<Option<Gears>>,
    /// The unit in which the speed of a governor is stated.
    pub(super) spin_unit: Option<Unit>,
    /// The stated room of each placed point, metres; 0 where none is stated.
    pub(super) rooms: Vec<f64>,
    /// Where placed points stand that follow from dimensions and guides: what a figure states from them counts from there.
    pub(super) settled: Vec<(PointId, GivenPoint)>,
    /// The points that stand for own coordinates in masses, loads and springs, by where these stand in the file.
    pub(super) spots: HashMap<usize, PointId>,
    /// Blocks that have points beside their pins: they slide as links do.
    pub(super) wide_blocks: Vec<LinkId>,
    /// A load changes with the angle of the input: in which turn that is counts.
    pub(super) loads_count_turns: bool,
    points: HashMap<String, PointId>,
    links: HashMap<u32, LinkId>,
}

impl<'s> Draft<'s> {
    /// The frame alone.
    pub(super) fn new(scales: &'s Scales, root: usize) -> Self {
        let frame =
            Link { number: 1, points: Vec::new(), form: Form::Placed, extra: Vec::new(), block: false };
        Self {
            scales,
            mechanism: Mechanism {
                links: vec![frame],
                points: Vec::new(),
                pins: Vec::new(),
                slides: Vec::new(),
                rolls: Vec::new(),
                contacts: Vec::new(),
                statements: Vec::new(),
                inputs: Vec::new(),
                forces: Forces::default(),
                asked: Vec::new(),
            },
            anchors: Anchors::new(root),
            input_units: Vec::new(),
            gears: Vec::new(),
            spin_unit: None,
            rooms: Vec::new(),
            settled: Vec::new(),
            spots: HashMap::new(),
            wide_blocks: Vec::new(),
            loads_count_turns: false,
            points: HashMap::new(),
            links: HashMap::from([(1, LinkId::FRAME)]),
        }
    }

    /// A mechanism that was read before, to look names up in it.
    pub(super) fn of(mechanism: Mechanism, scales: &'s Scales) -> Self {
        let points = mechanism.points.iter().enumerate().map(|(i, p)| (p.name.clone(), PointId(i))).collect();
        let links = mechanism.links.iter().enumerate().map(|(i, l)| (l.number, LinkId(i))).collect();
        Self { mechanism, points, links, ..Self::new(scales, 0) }
    }

    /// Adds a link; numbers come in ascending order.
    pub(super) fn add_link(&mut self, number: u32, at: usize) -> Res<LinkId> {
        let id = LinkId(self.mechanism.links.len());
        if id.0 > MOST {
            return Err(Fault::new(at, format!("more than {MOST} links")));
        }
        self.links.insert(number, id);
        self.mechanism.links.push(Link {
            number,
            points: Vec::new(),
            form: Form::Single,
            extra: Vec::new(),
            block: false,
        });
        self.anchors.add_link(at);
        Ok(id)
    }

    /// The point of this name, new if nobody mentioned it before.
    pub(super) fn mention(&mut self, name: &str, at: usize) -> Res<PointId> {
        if let Some(id) = self.points.get(name) {
            return Ok(*id);
        }
        point_name(name, at)?;
        let id = PointId(self.mechanism.points.len());
        if id.0 >= MOST {
            return Err(Fault::new(at, format!("more than {MOST} points")));
        }
        let point = Point { name: name.to_owned(), place: Place::Unknown, links: Vec::new(), journal: None };
        self.points.insert(name.to_owned(), id);
        self.mechanism.points.push(point);
        self.anchors.points.push(at);
        Ok(id)
    }

    /// Puts a point into a link.
    pub(super) fn join(&mut self, link: LinkId, point: PointId) {
        self.mechanism.links[link.0].points.push(point);
        self.mechanism.points[point.0].links.push(link);
    }

    /// The point of this name, which must exist.
    pub(super) fn point_named(&self, name: &str, at: usize) -> Res<PointId> {
        self.points.get(name).copied().ok_or_else(|| {
            let names = self.mechanism.points.iter().map(|p| p.name.as_str());
            Fault::new(at, format!("there is no point `{name}`")).known(name, names)
        })
    }

    /// The point that a value names.
    pub(super) fn point(&self, value: &Value<'_>) -> Res<PointId> {
        self.point_named(value.text("the name of a point")?, value.at)
    }

    /// The point that a value names, which must stand in this link.
    pub(super) fn point_in(&self, value: &Value<'_>, link: LinkId) -> Res<PointId> {
        let point = self.point(value)?;
        if self.stands_in(point, link) {
            return Ok(point);
        }
        let what = format!("{} does not stand in {}", self.say_point(point), self.say(link));
        let names: Vec<&str> = self.link(link).points.iter().map(|p| self.say_point(*p)).collect();
        Err(Fault::new(value.at, what).mend(match names.as_slice() {
            [] => "give coordinates [x, y] instead".to_owned(),
            names => format!("its points are {}", names[..names.len().min(12)].join(", ")),
        }))
    }

    /// The link of this number, which must exist.
    pub(super) fn link_of(&self, number: u32, at: usize) -> Res<LinkId> {
        self.links.get(&number).copied().ok_or_else(|| {
            let names: Vec<String> = self.mechanism.links.iter().map(|l| l.number.to_string()).collect();
            Fault::new(at, format!("there is no link {number}"))
                .known(&number.to_string(), names.iter().map(String::as_str))
        })
    }

    /// The link that a value names.
    pub(super) fn link_at(&self, value: &Value<'_>) -> Res<LinkId> {
        self.link_of(value.whole("the number of a link")?, value.at)
    }

    /// The moving link that a value names.
    pub(super) fn moving_link(&self, value: &Value<'_>) -> Res<LinkId> {
        let link = self.link_at(value)?;
        if link == LinkId::FRAME {
            return Err(Fault::new(value.at, "link 1 is the frame and does not move"));
        }
        Ok(link)
    }

    pub(super) fn link(&self, id: LinkId) -> &Link {
        self.mechanism.link(id)
    }

    pub(super) fn stands_in(&self, point: PointId, link: LinkId) -> bool {
        self.mechanism.point(point).links.contains(&link)
    }

    pub(super) fn is_fixed(&self, point: PointId) -> bool {
        self.mechanism.is_fixed(point)
    }

    /// Whether the file gives its exact place, by coordinates or by what a figure states.
    pub(super) fn is_exact(&self, point: PointId) -> bool {
        matches!(self.mechanism.point(point).place, Place::Fixed(_) | Place::Placed(_) | Place::Stated(_))
    }

    /// By how much a placed point may lie elsewhere, as far as the scene says it, metres.
    pub(super) fn room(&self, point: PointId) -> f64 {
        self.rooms.get(point.0).copied().unwrap_or(0.0)
    }

    /// `link 3`, or `link 1 (the frame)`.
    pub(super) fn say(&self, link: LinkId) -> String {
        match self.link(link).number {
            1 => "link 1 (the frame)".to_owned(),
            number => format!("link {number}"),
        }
    }

    pub(super) fn say_point(&self, point: PointId) -> &str {
        &self.mechanism.point(point).name
    }

    /// The angle that an input states for a link.
    pub(super) fn input_angle(&self, of: LinkId) -> Option<Given> {
        self.mechanism.inputs.iter().find_map(|input| match input {
            Input::Angle { link, angle, .. } | Input::Speed { link, angle, .. } if *link == of => *angle,
            _ => None,
        })
    }

    /// The pin that rides, or the first joint of the link that rides.
    pub(super) fn riding_point(&self, rider: &Rider) -> Option<PointId> {
        match rider {
            Rider::Pin { point, .. } => Some(*point),
            Rider::Link { link, .. } => self.link(*link).points.first().copied(),
        }
    }

    /// The turning pairs, once all joints are known: at each point, its first link (the frame, if it is
    /// among them) with every other.
    pub(super) fn pin_joints(&mut self) {
        for (index, point) in self.mechanism.points.iter().enumerate() {
            if let Some((&first, others)) = point.links.split_first() {
                let pin = |&other| crate::mechanism::Pin { point: PointId(index), links: [first, other] };
                self.mechanism.pins.extend(others.iter().map(pin));
            }
        }
    }
}

/// Whether a guide is straight.
pub(super) fn is_straight(guide: &Guide) -> bool {
    matches!(guide.path, Path::Straight { .. })
}

/// A point's name must be readable inside `v(B/A)` and never look like a link's number.
fn point_name(name: &str, at: usize) -> Res<()> {
    let fine = |c: char| !c.is_whitespace() && !c.is_control() && !"/,()\"`@".contains(c);
    if name.chars().next().is_some_and(char::is_alphabetic) && name.chars().all(fine) && name.len() <= 64 {
        return Ok(());
    }
    Err(Fault::new(at, format!("`{}` cannot name a point", name.escape_debug())).mend(
        "a name begins with a letter and has no blank, slash, comma, `@`, quote or parenthesis, such as `A` or `O2`",
    ))
}
