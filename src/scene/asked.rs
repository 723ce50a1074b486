//! Names of quantities: `v(B/A)`, `omega(3)`, `I(1,3)`.

use super::cycle::{self, CYCLE};
use super::diagnostic::{Fault, Res, list};
use super::draft::{Draft, is_straight};
use super::force_names::{self, FORCES};
use super::json::{Fields, Kind, Value};
use super::keys;
use super::units::{Measure, Scale, Scales};
use crate::mechanism::force::{Action, Force, Heaviness, Inertia, Share};
use crate::mechanism::quantity::{Asked, Method, Order, Quantity, Unit};
use crate::mechanism::{LinkId, Mechanism, PointId, Rider};

/// A kind of quantity by the letters before the parenthesis.
#[derive(Debug, Clone, Copy)]
pub struct Named {
    /// `v`, `omega`.
    pub head: &'static str,
    /// Its forms, each with what it means.
    pub forms: &'static [(&'static str, &'static str)],
}

/// Every name that a scene may ask for.
pub const QUANTITIES: [Named; 49] = [
    Named {
        head: "v",
        forms: &[
            ("v(B)", "velocity of point B"),
            ("v(B/A)", "velocity of B relative to A"),
            ("v(A@4)", "velocity of the point of link 4 that lies under the sliding pin A (textbooks: A4)"),
        ],
    },
    Named {
        head: "a",
        forms: &[
            ("a(B)", "acceleration of point B"),
            ("a(B/A)", "acceleration of B relative to A"),
            ("a(A@4)", "acceleration of the point of link 4 under the sliding pin A"),
        ],
    },
    Named {
        head: "an",
        forms: &[
            ("an(B/A)", "normal part of a(B/A), for two points of one link"),
            ("an(B)", "normal part of a(B), for a point of a link pivoted to the frame"),
            ("an(A@4)", "normal part of a(A@4), about the fixed pivot of link 4"),
        ],
    },
    Named {
        head: "at",
        forms: &[
            ("at(B/A)", "tangential part of a(B/A), for two points of one link"),
            ("at(B)", "tangential part of a(B), for a point of a link pivoted to the frame"),
            ("at(A@4)", "tangential part of a(A@4), about the fixed pivot of link 4"),
        ],
    },
    Named {
        head: "omega",
        forms: &[
            ("omega(3)", "angular velocity of link 3, counter-clockwise positive"),
            ("omega(3/2)", "angular velocity of link 3 relative to link 2"),
        ],
    },
    Named {
        head: "alpha",
        forms: &[
            ("alpha(3)", "angular acceleration of link 3, counter-clockwise positive"),
            ("alpha(3/2)", "angular acceleration of link 3 relative to link 2"),
        ],
    },
    Named { head: "ratio", forms: &[("ratio(4/2)", "angular velocity of link 4 over that of link 2")] },
    Named {
        head: "advantage",
        forms: &[("advantage(4/2)", "mechanical advantage: torque at link 4 for a unit of torque at link 2")],
    },
    Named {
        head: "slip",
        forms: &[("slip(A/4)", "velocity of pin A along link 4, relative to the point under it")],
    },
    Named {
        head: "aslip",
        forms: &[("aslip(A/4)", "acceleration of pin A as link 4 sees it, without Coriolis")],
    },
    Named { head: "aslipn", forms: &[("aslipn(A/4)", "the part of aslip(A/4) normal to an arc guide")] },
    Named { head: "aslipt", forms: &[("aslipt(A/4)", "the part of aslip(A/4) along an arc guide")] },
    Named { head: "coriolis", forms: &[("coriolis(A/4)", "Coriolis acceleration of pin A on link 4")] },
    Named { head: "I", forms: &[("I(1,3)", "instant centre of links 1 and 3")] },
    Named {
        head: "rub",
        forms: &[
            ("rub(B)", "rubbing speed at pin B; its `radius` stands in `pins`"),
            ("rub(B,3/4)", "the same at a pin of more than two links: between links 3 and 4"),
        ],
    },
    Named { head: "rho", forms: &[("rho(B)", "radius of curvature of the path of B")] },
    Named { head: "x", forms: &[("x(B)", "place of point B")] },
    Named { head: "angle", forms: &[("angle(3)", "angle of the own x-axis of link 3 from +x")] },
    Named {
        head: "transmission",
        forms: &[(
            "transmission(3/4)",
            "angle between coupler 3 and output 4 at their pin, 0 to 180 degrees",
        )],
    },
    FORCES[0],
    FORCES[1],
    FORCES[2],
    FORCES[3],
    FORCES[4],
    FORCES[5],
    FORCES[6],
    FORCES[7],
    FORCES[8],
    FORCES[9],
    FORCES[10],
    FORCES[11],
    FORCES[12],
    FORCES[13],
    FORCES[14],
    CYCLE[0],
    CYCLE[1],
    CYCLE[2],
    CYCLE[3],
    CYCLE[4],
    CYCLE[5],
    CYCLE[6],
    CYCLE[7],
    CYCLE[8],
    CYCLE[9],
    CYCLE[10],
    CYCLE[11],
    CYCLE[12],
    CYCLE[13],
    CYCLE[14],
];

/// The forms of a name, for messages.
fn written(named: &Named) -> String {
    let forms: Vec<&str> = named.forms.iter().map(|(form, _)| *form).collect();
    match forms.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => forms.concat(),
    }
}

/// Reads `find`; without it, everything is asked.
pub(super) fn read(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else {
        draft.mechanism.asked = everything(draft);
        return Ok(());
    };
    for item in value.list("a list of names, such as [\"v(B)\", \"omega(3)\"]")? {
        let asked = match &item.kind {
            Kind::Text(name) => asked(name, item.at, None, draft)?,
            Kind::Object(_) => {
                let fields = Fields::of(item, keys::FIND, "a name")?;
                let name = fields.need("name", "the quantity, such as \"v(B)\"")?;
                let mut asked =
                    asked(name.text("the name of a quantity")?, name.at, fields.get("unit"), draft)?;
                if let Some(value) = fields.get("method") {
                    asked.method = method(value, &asked, &fields, draft)?;
                }
                if !matches!(asked.method, Method::TwoMasses { .. })
                    && let Some(value) = fields.get("first").or_else(|| fields.get("second"))
                {
                    return Err(Fault::new(value.at, "only the method `two-masses` takes points"));
                }
                asked
            }
            _ => return Err(item.unexpected("the name of a quantity, such as \"v(B)\"")),
        };
        draft.mechanism.asked.push(asked);
        draft.anchors.asked.push(item.at);
    }
    beside_the_lever(draft);
    one_acceleration_polygon(draft)
}

/// The lever is a third number for an effort: that of the polygons stands before it.
fn beside_the_lever(draft: &mut Draft<'_>) {
    let mut place = 0;
    while let Some(asked) = draft.mechanism.asked.get(place) {
        let alone = Asked { method: Method::Polygon, ..asked.clone() };
        let plain = |other: &Asked| other.method == Method::Polygon && other.quantity == alone.quantity;
        if asked.method == Method::Lever && !draft.mechanism.asked.iter().any(plain) {
            draft.mechanism.asked.insert(place, alone);
            let at = draft.anchors.asked[place];
            draft.anchors.asked.insert(place, at);
            place += 1;
        }
        place += 1;
    }
}

/// There is one acceleration polygon, fed from one velocity diagram.
fn one_acceleration_polygon(draft: &Draft<'_>) -> Res<()> {
    let asked = &draft.mechanism.asked;
    let other = |a: &Asked| a.quantity.order() == Order::Acceleration && a.method == Method::Polygon;
    let (Some(fed), Some(other)) = (asked.iter().find(|a| a.fed_by_centres()), asked.iter().position(other))
    else {
        return Ok(());
    };
    let what = format!("`{}` is asked for by centres, and this acceleration by the polygon", fed.name);
    Err(Fault::new(draft.anchors.asked[other], what)
        .mend("there is one acceleration polygon: ask for all accelerations by one method, or in two scenes"))
}

/// The method by which a quantity is asked.
fn method(value: &Value<'_>, asked: &Asked, fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<Method> {
    let name = value.text("the name of a method")?;
    if !Method::names().any(|known| known == name) {
        let fault = Fault::new(value.at, format!("`{name}` is not a method"));
        return Err(fault.known(name, Method::names()));
    }
    if !Method::names_for(&asked.quantity).any(|fitting| fitting == name) {
        let fault = Fault::new(value.at, format!("the method `{name}` does not lead to `{}`", asked.name));
        let fitting: Vec<&str> = Method::names_for(&asked.quantity).collect();
        return Err(fault.mend(format!("choose {}", list(&fitting))));
    }
    let Some(method) = Method::PLAIN.into_iter().find(|method| method.name() == name) else {
        return two_masses(value, asked, fields, draft);
    };
    if method == Method::ThreeForce && !draft.mechanism.forces.friction.is_empty() {
        let fault = Fault::new(value.at, "three forces meet in a point where nothing rubs");
        return Err(fault.mend(format!("ask for \"{}\" alone", asked.name)));
    }
    if let (Method::Lever, Quantity::Force(Force::Torque(input) | Force::Drive(input), _)) =
        (method, asked.quantity)
        && let Some(why) = draft.mechanism.lever_refused(input)
    {
        return Err(Fault::new(value.at, why).mend(format!("ask for \"{}\" alone", asked.name)));
    }
    Ok(method)
}

/// The points at which two masses stand for a link.
fn two_masses(value: &Value<'_>, asked: &Asked, fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<Method> {
    let Quantity::Force(Force::Vector(Action::Inertia(link)), _) = asked.quantity else {
        return Err(Fault::new(value.at, format!("two masses do not stand for `{}`", asked.name)));
    };
    let mechanism = &draft.mechanism;
    let number = mechanism.link(link).number;
    let Some(mass) = mechanism.forces.mass(link) else {
        return Err(Fault::new(value.at, format!("link {number} has no mass")));
    };
    if mass.heaviness == Heaviness::None || mass.inertia == Inertia::Point {
        let fault = Fault::new(
            value.at,
            format!("two masses stand for a mass and a moment of inertia, and link {number} has but one"),
        );
        return Err(fault.mend("give both in `masses`"));
    }
    let point = |value: &Value<'_>| -> Res<PointId> {
        let name = value.text("the name of a point")?;
        let point = draft.point_named(name, value.at)?;
        if !mechanism.link(link).points.contains(&point) {
            let points = mechanism.link(link).points.iter();
            let fault = Fault::new(value.at, format!("`{name}` is no joint of link {number}"));
            return Err(fault.known(name, points.map(|point| draft.say_point(*point))));
        }
        if point == mass.centre {
            let what = format!("`{name}` is the mass centre of link {number}: each mass stands beside it");
            return Err(Fault::new(value.at, what));
        }
        Ok(point)
    };
    let first = point(fields.need("first", "the point of the first mass, such as \"A\"")?)?;
    let second = match fields.get("second") {
        Some(value) => {
            let second = point(value)?;
            if second == first {
                return Err(Fault::new(value.at, "the two masses stand at one point"));
            }
            Some(second)
        }
        None => None,
    };
    Ok(Method::TwoMasses { first, second })
}

/// One asked quantity in its unit.
pub(super) fn asked(name: &str, at: usize, unit: Option<&Value<'_>>, draft: &Draft<'_>) -> Res<Asked> {
    let quantity = parse(name, at, draft)?;
    let unit = match unit {
        None => default_scale(&quantity, draft.scales).unit(),
        Some(unit) => {
            let symbol = unit.text("the name of a unit")?;
            Scale::parse(symbol, unit.at)?.must_be(measure(&quantity), unit.at)?.unit()
        }
    };
    Ok(Asked { name: name.to_owned(), quantity, unit, method: Method::default() })
}

/// A quantity of a mechanism that was read before, by its name.
pub(crate) fn named(name: &str, at: usize, mechanism: &Mechanism, scales: &Scales) -> Res<Asked> {
    Names::new(mechanism, scales).quantity(name, at)
}

/// A mechanism that was read before, to look up many names in it.
pub(crate) struct Names<'s>(Draft<'s>);

impl<'s> Names<'s> {
    pub(crate) fn new(mechanism: &Mechanism, scales: &'s Scales) -> Self {
        Self(Draft::of(mechanism.clone(), scales))
    }

    /// A quantity, by its name.
    pub(crate) fn quantity(&self, name: &str, at: usize) -> Res<Asked> {
        asked(name, at, None, &self.0)
    }
}

/// What a quantity measures.
pub(crate) fn measure(quantity: &Quantity) -> Measure {
    match quantity {
        Quantity::Velocity(_)
        | Quantity::RelativeVelocity(..)
        | Quantity::Slip(..)
        | Quantity::CoincidentVelocity(..)
        | Quantity::Rub(..) => Measure::Velocity,
        Quantity::Acceleration(_)
        | Quantity::RelativeAcceleration(..)
        | Quantity::RelativeNormal(..)
        | Quantity::RelativeTangential(..)
        | Quantity::Normal(_)
        | Quantity::Tangential(_)
        | Quantity::SlipAcceleration(..)
        | Quantity::SlipNormal(..)
        | Quantity::SlipTangential(..)
        | Quantity::CoincidentAcceleration(..)
        | Quantity::ContactNormal(..)
        | Quantity::CoincidentNormal(..)
        | Quantity::CoincidentTangential(..)
        | Quantity::Coriolis(..) => Measure::Acceleration,
        Quantity::Omega(_) | Quantity::RelativeOmega(..) => Measure::AngularVelocity,
        Quantity::Alpha(_) | Quantity::RelativeAlpha(..) => Measure::AngularAcceleration,
        Quantity::Ratio(..) | Quantity::Advantage(..) => Measure::Number,
        Quantity::Centre(..) | Quantity::Position(_) | Quantity::PathRadius(_) => Measure::Length,
        Quantity::Angle(_) | Quantity::Transmission(..) => Measure::Angle,
        Quantity::Cycle(of) => cycle::measure(*of),
        Quantity::Force(force, _) => match force {
            Force::Vector(_)
            | Force::Along { .. }
            | Force::Across { .. }
            | Force::Drive(_)
            | Force::Pull(_) => Measure::Force,
            Force::Torque(_)
            | Force::LoadTorque(_)
            | Force::Twist(_)
            | Force::InertiaTorque(_)
            | Force::Moment(..) => Measure::Torque,
            Force::Offset(_) | Force::Arm(..) => Measure::Length,
            Force::Spin => Measure::AngularVelocity,
        },
    }
}

/// The unit in which a quantity is answered where the scene says nothing.
pub(crate) fn default_scale(quantity: &Quantity, scales: &Scales) -> Scale {
    match quantity {
        // A transmission angle is read in degrees whatever the scene counts in.
        Quantity::Transmission(..) => Scale::degrees(),
        _ => scales.bare(measure(quantity)).clone(),
    }
}

/// All velocities, accelerations, ω and α of what moves.
fn everything(draft: &Draft<'_>) -> Vec<Asked> {
    let mechanism = &draft.mechanism;
    let unit = |measure| -> Unit { draft.scales.bare(measure).unit() };
    let points: Vec<PointId> =
        (0..mechanism.points.len()).map(PointId).filter(|p| !mechanism.is_fixed(*p)).collect();
    let mut asked = Vec::new();
    let mut ask = |name: String, quantity: Quantity| {
        asked.push(Asked { name, quantity, unit: unit(measure(&quantity)), method: Method::default() });
    };
    if let Some(cycle) = &mechanism.forces.cycle {
        for of in cycle::everything(cycle) {
            ask(of.name(), Quantity::Cycle(of));
        }
        return asked;
    }
    if !mechanism.forces.is_empty() {
        for force in force_names::everything(draft) {
            ask(force.name(mechanism), Quantity::Force(force, Share::Total));
        }
        return asked;
    }
    for &point in &points {
        ask(format!("v({})", draft.say_point(point)), Quantity::Velocity(point));
    }
    for &point in &points {
        ask(format!("a({})", draft.say_point(point)), Quantity::Acceleration(point));
    }
    for link in mechanism.moving() {
        ask(format!("omega({})", mechanism.link(link).number), Quantity::Omega(link));
    }
    for link in mechanism.moving() {
        ask(format!("alpha({})", mechanism.link(link).number), Quantity::Alpha(link));
    }
    asked
}

/// A name while it is read.
struct Name<'n, 'd, 's> {
    whole: &'n str,
    at: usize,
    /// How it should look.
    named: &'static Named,
    draft: &'d Draft<'s>,
}

/// Reads a name, and that what it names exists.
fn parse(name: &str, at: usize, draft: &Draft<'_>) -> Res<Quantity> {
    let heads = || QUANTITIES.iter().map(|named| named.head);
    let unknown = |head: &str| {
        let fault = Fault::new(at, format!("`{name}` is not the name of a quantity"));
        if let Some(named) = QUANTITIES.iter().find(|named| named.head == head) {
            return fault.mend(format!("write {}", written(named)));
        }
        // `omega3`, `vB`: the parentheses are forgotten.
        let letters = head.trim_end_matches(|c: char| c.is_ascii_digit() || c.is_uppercase());
        match QUANTITIES.iter().find(|named| named.head == letters) {
            Some(named) => fault.mend(format!("write {}", written(named))),
            None => fault.known(head, heads()),
        }
    };
    if let Some(of_cycle) = cycle::parse(name, at, draft)? {
        return Ok(of_cycle);
    }
    if let Some(force) = force_names::parse(name, at, draft)? {
        return Ok(force);
    }
    let (head, inside) = name.split_once('(').ok_or_else(|| unknown(name.trim()))?;
    let head = head.trim();
    let inside = inside.trim_end().strip_suffix(')').ok_or_else(|| unknown(head))?.trim();
    let named = QUANTITIES.iter().find(|named| named.head == head).ok_or_else(|| unknown(head))?;
    let head = named.head;
    let name = Name { whole: name, at, named, draft };
    let separator = if matches!(head, "I" | "rub") { ',' } else { '/' };
    let (first, second) = match inside.split_once(separator) {
        Some((first, second)) => (first.trim(), Some(second.trim())),
        None => (inside, None),
    };
    if let (None, Some((pin, link))) = (second, first.split_once('@')) {
        let (pin, link) = (pin.trim(), link.trim());
        let under = |quantity: fn(PointId, LinkId) -> Quantity| {
            name.sliding(pin, link, false).map(|(p, l)| quantity(p, l))
        };
        return match head {
            "v" => under(Quantity::CoincidentVelocity),
            "a" => under(Quantity::CoincidentAcceleration),
            "an" => under(Quantity::CoincidentNormal),
            "at" => under(Quantity::CoincidentTangential),
            _ => Err(unknown(head)),
        };
    }
    match (head, second) {
        ("v", None) => Ok(Quantity::Velocity(name.point(first)?)),
        ("a", None) => Ok(Quantity::Acceleration(name.point(first)?)),
        ("v", Some(second)) => name.points(first, second).map(|(b, a)| Quantity::RelativeVelocity(b, a)),
        ("a", Some(second)) => name.points(first, second).map(|(b, a)| Quantity::RelativeAcceleration(b, a)),
        ("an", Some(second)) => name.one_link(first, second).map(|(b, a)| Quantity::RelativeNormal(b, a)),
        ("at", Some(second)) => name.one_link(first, second).map(|(b, a)| Quantity::RelativeTangential(b, a)),
        ("an", None) => Ok(Quantity::Normal(name.pivoted(first)?)),
        ("at", None) => Ok(Quantity::Tangential(name.pivoted(first)?)),
        ("omega", None) => Ok(Quantity::Omega(name.link(first)?)),
        ("alpha", None) => Ok(Quantity::Alpha(name.link(first)?)),
        ("angle", None) => Ok(Quantity::Angle(name.link(first)?)),
        ("omega", Some(second)) => name.links(first, second).map(|(b, a)| Quantity::RelativeOmega(b, a)),
        ("alpha", Some(second)) => name.links(first, second).map(|(b, a)| Quantity::RelativeAlpha(b, a)),
        ("ratio", Some(second)) => name.links(first, second).map(|(b, a)| Quantity::Ratio(b, a)),
        ("advantage", Some(second)) => name.links(first, second).map(|(b, a)| Quantity::Advantage(b, a)),
        ("I", Some(second)) => name.links(first, second).map(|(b, a)| Quantity::Centre(b, a)),
        ("transmission", Some(second)) => {
            let (coupler, output) = name.links(first, second)?;
            name.pinned(coupler, output)?;
            Ok(Quantity::Transmission(coupler, output))
        }
        ("slip", Some(link)) => name.sliding(first, link, false).map(|(p, l)| Quantity::Slip(p, l)),
        ("aslip", Some(link)) => {
            name.sliding(first, link, false).map(|(p, l)| Quantity::SlipAcceleration(p, l))
        }
        ("coriolis", Some(link)) => name.sliding(first, link, false).map(|(p, l)| Quantity::Coriolis(p, l)),
        ("aslipn", Some(link)) => name.sliding(first, link, true).map(|(p, l)| Quantity::SlipNormal(p, l)),
        ("aslipt", Some(link)) => {
            name.sliding(first, link, true).map(|(p, l)| Quantity::SlipTangential(p, l))
        }
        ("rub", links) => name.rubbing(first, links),
        ("rho", None) => Ok(Quantity::PathRadius(name.point(first)?)),
        ("x", None) => Ok(Quantity::Position(name.point(first)?)),
        _ => Err(unknown(head)),
    }
}

impl<'n> Name<'n, '_, '_> {
    fn fault(&self, what: impl AsRef<str>) -> Fault {
        Fault::new(self.at, format!("`{}`: {}", self.whole, what.as_ref()))
    }

    fn point(&self, name: &str) -> Res<PointId> {
        let points = &self.draft.mechanism.points;
        self.draft.point_named(name, self.at).map_err(|_| {
            let fault = self.fault(format!("there is no point `{name}`"));
            if name.parse::<u32>().is_ok() || name.is_empty() {
                return fault.mend(format!("write {}", written(self.named)));
            }
            if let Some(meant) = self.coincident(name) {
                return fault.mend(meant);
            }
            fault.known(name, points.iter().map(|p| p.name.as_str()))
        })
    }

    /// What is meant by the `A4` of textbooks, the point of link 4 that lies under A.
    fn coincident(&self, name: &str) -> Option<String> {
        let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
        let number = &name[letters.len()..];
        let link = self.draft.link_of(number.parse().ok()?, self.at).ok()?;
        let point = self.draft.point_named(letters, self.at).ok()?;
        let under = format!("the point of link {number} that lies under {letters}");
        let slides =
            |link: LinkId| {
                self.draft.mechanism.slides.iter().any(|slide| {
                    slide.guide.link == link && self.draft.riding_point(&slide.rider) == Some(point)
                })
            };
        let pair = self.whole.contains('/');
        // `v(A2/A4)`: the other one of the pair may be the one that carries the guide.
        let others = self.whole.split(['(', '/', ')']).map(str::trim);
        let guide = others
            .filter_map(|other| other.strip_prefix(letters)?.parse().ok())
            .filter_map(|number| self.draft.link_of(number, self.at).ok())
            .find(|link| slides(*link));
        Some(match self.named.head {
            "v" | "a" if pair && guide.is_some() => {
                let head = if self.named.head == "v" { "slip" } else { "aslip" };
                let number = guide.map_or(0, |link| self.draft.link(link).number);
                format!(
                    "did you mean `{head}({letters}/{number})`, {letters} relative to the point of link {number} under it?"
                )
            }
            head @ ("v" | "a" | "an" | "at") if !pair && slides(link) => {
                format!("did you mean `{head}({letters}@{number})`, {under}?")
            }
            // A point of its own link is that point.
            head if self.draft.stands_in(point, link) => format!("did you mean `{head}({letters})`?"),
            _ => return None,
        })
    }

    fn link(&self, number: &str) -> Res<LinkId> {
        let found = number.parse().ok().and_then(|n| self.draft.link_of(n, self.at).ok());
        found.ok_or_else(|| {
            let fault = self.fault(format!("there is no link `{number}`"));
            if number.parse::<u32>().is_err() {
                return fault.mend(format!("write {}", written(self.named)));
            }
            let known: Vec<String> =
                self.draft.mechanism.links.iter().map(|l| l.number.to_string()).collect();
            fault.known(number, known.iter().map(String::as_str))
        })
    }

    fn points(&self, first: &str, second: &str) -> Res<(PointId, PointId)> {
        let pair = (self.point(first)?, self.point(second)?);
        if pair.0 == pair.1 {
            return Err(self.fault("the two points are one"));
        }
        Ok(pair)
    }

    fn links(&self, first: &str, second: &str) -> Res<(LinkId, LinkId)> {
        let pair = (self.link(first)?, self.link(second)?);
        if pair.0 == pair.1 {
            return Err(self.fault("the two links are one"));
        }
        Ok(pair)
    }

    /// Two points of one link.
    fn one_link(&self, first: &str, second: &str) -> Res<(PointId, PointId)> {
        let (b, a) = self.points(first, second)?;
        let links = &self.draft.mechanism.point(b).links;
        if links.iter().any(|link| self.draft.stands_in(a, *link)) {
            return Ok((b, a));
        }
        let mates = self.mates(b);
        let fault = self.fault(format!("{first} and {second} do not stand in one link"));
        let mates: Vec<&str> = mates.iter().map(|p| self.draft.say_point(*p)).collect();
        Err(fault.mend(match mates.as_slice() {
            [] => "only points of one link have a normal and a tangential part".to_owned(),
            mates => format!("points that share a link with {first}: {}", list(&mates[..mates.len().min(8)])),
        }))
    }

    /// The other points of a point's links.
    fn mates(&self, point: PointId) -> Vec<PointId> {
        let links = &self.draft.mechanism.point(point).links;
        let points = links.iter().flat_map(|link| &self.draft.link(*link).points);
        let mut mates: Vec<PointId> = points.copied().filter(|p| *p != point).take(64).collect();
        mates.dedup();
        mates
    }

    /// A moving point of a link that turns about a fixed pin.
    fn pivoted(&self, name: &str) -> Res<PointId> {
        let point = self.point(name)?;
        if self.draft.is_fixed(point) {
            return Err(self.fault(format!("{name} is a fixed point")));
        }
        let links = &self.draft.mechanism.point(point).links;
        let pivots = |link: &LinkId| self.draft.link(*link).points.iter().any(|p| self.draft.is_fixed(*p));
        if links.iter().any(pivots) {
            return Ok(point);
        }
        let fault =
            self.fault(format!("{name} stands in no link that is pivoted to the frame by a fixed pin"));
        Err(fault.mend(format!("name a second point of its link: {}({name}/…)", self.named.head)))
    }

    /// Two links with a pin between them.
    fn pinned(&self, one: LinkId, other: LinkId) -> Res<()> {
        if self.draft.link(one).points.iter().any(|p| self.draft.stands_in(*p, other)) {
            return Ok(());
        }
        let [one, other] = [one, other].map(|link| self.draft.say(link));
        Err(self.fault(format!("{one} and {other} have no pin in common")))
    }

    /// A pin and a link on which it, its block or its link slides.
    fn sliding(&self, pin: &str, link: &str, on_arc: bool) -> Res<(PointId, LinkId)> {
        let (point, link) = (self.point(pin)?, self.link(link)?);
        let slides = &self.draft.mechanism.slides;
        let rides = |rider: &Rider| match rider {
            Rider::Pin { point: rider, .. } => *rider == point,
            Rider::Link { link: rider, .. } => self.draft.stands_in(point, *rider),
        };
        let mut pairs = slides.iter().filter(|slide| slide.guide.link == link && rides(&slide.rider));
        let Some(slide) = pairs.next() else {
            let on: Vec<String> =
                slides.iter().filter(|s| rides(&s.rider)).map(|s| self.draft.say(s.guide.link)).collect();
            let fault = self.fault(format!("{pin} does not slide on {}", self.draft.say(link)));
            return Err(if on.is_empty() {
                let riders = slides.iter().filter_map(|s| self.draft.riding_point(&s.rider));
                let riders: Vec<&str> = riders.map(|p| self.draft.say_point(p)).take(8).collect();
                if riders.is_empty() {
                    fault
                } else {
                    fault.mend(format!("what slides: {}", riders.join(", ")))
                }
            } else {
                fault.mend(format!("it slides on {}", on.join(", ")))
            });
        };
        if on_arc && is_straight(&slide.guide) && pairs.all(|slide| is_straight(&slide.guide)) {
            let fault =
                self.fault(format!("{pin} slides along a straight line, where nothing is normal to it"));
            return Err(fault.mend(format!("ask for `aslip({pin}/{})`", self.draft.link(link).number)));
        }
        Ok((point, link))
    }

    fn rubbing(&self, pin: &str, links: Option<&str>) -> Res<Quantity> {
        let point = self.point(pin)?;
        let of = &self.draft.mechanism.point(point);
        let pair = match links {
            Some(links) => {
                let (one, other) = links.split_once('/').ok_or_else(|| {
                    self.fault("two links rub").mend(format!("write {}", written(self.named)))
                })?;
                let pair = self.links(one.trim(), other.trim())?;
                for link in [pair.0, pair.1] {
                    if !of.links.contains(&link) {
                        return Err(self.fault(format!("{pin} does not stand in {}", self.draft.say(link))));
                    }
                }
                pair
            }
            None => match of.links.as_slice() {
                [one, other] => (*one, *other),
                [] | [_] => return Err(self.fault(format!("{pin} is no pin between two links"))),
                more => {
                    let numbers: Vec<String> =
                        more.iter().map(|l| self.draft.link(*l).number.to_string()).collect();
                    let fault = self.fault(format!("{pin} joins links {}", numbers.join(", ")));
                    return Err(fault
                        .mend(format!("say which two, such as rub({pin},{}/{})", numbers[0], numbers[1])));
                }
            },
        };
        if of.journal.is_none() {
            let fault = self.fault(format!("the radius of pin {pin} is missing"));
            return Err(fault.mend(format!("add \"pins\": {{\"{pin}\": {{\"radius\": …}}}}")));
        }
        Ok(Quantity::Rub(point, pair.0, pair.1))
    }
}
