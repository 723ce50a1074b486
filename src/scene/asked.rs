//! Names of quantities: `v(B/A)`, `omega(3)`, `I(1,3)`.

use super::cycle::{self, CYCLE};
use super::diagnostic::{Fault, Res, list};
use super::draft::{Draft, is_straight};
use super::force_names::{self, FORCES};
use super::json::{Fields, Kind, Value};
use super::keys;
use super::units::{Scale, Scales};
use crate::limits::ASKED;
use crate::mechanism::force::{Action, Force, Heaviness, Inertia, Share};
use crate::mechanism::quantity::{self, Asked, Method, Order, Quantity, Row, Unit};
use crate::mechanism::{LinkId, Mechanism, PointId, Rider};

/// How the name of a quantity of motion is read: what stands in its parentheses, and what of it must be so.
#[derive(Clone, Copy)]
enum Reading {
    /// `v(B)`.
    Point(fn(PointId) -> Quantity),
    /// `an(B)`: a point of a link that turns about a fixed pin.
    Pivoted(fn(PointId) -> Quantity),
    /// `v(B/A)`.
    Points(fn(PointId, PointId) -> Quantity),
    /// `an(B/A)`: two points of one link.
    OneLink(fn(PointId, PointId) -> Quantity),
    /// `omega(3)`.
    Link(fn(LinkId) -> Quantity),
    /// `omega(3/2)`, `I(1,3)`.
    Links(fn(LinkId, LinkId) -> Quantity),
    /// `transmission(3/4)`: two links with a pin between them.
    Pinned(fn(LinkId, LinkId) -> Quantity),
    /// `v(A@4)`: a pin and a link on which it slides.
    Under(fn(PointId, LinkId) -> Quantity),
    /// `slip(A/4)`: a pin and a link on which it slides.
    Sliding(fn(PointId, LinkId) -> Quantity),
    /// `aslipn(A/4)`: a pin and a link on which it slides along an arc.
    OnArc(fn(PointId, LinkId) -> Quantity),
    /// `rub(B,3/4)`: a pin of two links; `rub(B)` where it has no others.
    Rubbing(fn(PointId, LinkId, LinkId) -> Quantity),
}

/// The quantities of motion that a scene may ask for.
const MOTION: [Reading; 29] = [
    Reading::Point(Quantity::Velocity),
    Reading::Points(Quantity::RelativeVelocity),
    Reading::Under(Quantity::CoincidentVelocity),
    Reading::Point(Quantity::Acceleration),
    Reading::Points(Quantity::RelativeAcceleration),
    Reading::Under(Quantity::CoincidentAcceleration),
    Reading::OneLink(Quantity::RelativeNormal),
    Reading::Pivoted(Quantity::Normal),
    Reading::Under(Quantity::CoincidentNormal),
    Reading::OneLink(Quantity::RelativeTangential),
    Reading::Pivoted(Quantity::Tangential),
    Reading::Under(Quantity::CoincidentTangential),
    Reading::Link(Quantity::Omega),
    Reading::Links(Quantity::RelativeOmega),
    Reading::Link(Quantity::Alpha),
    Reading::Links(Quantity::RelativeAlpha),
    Reading::Links(Quantity::Ratio),
    Reading::Links(Quantity::Advantage),
    Reading::Sliding(Quantity::Slip),
    Reading::Sliding(Quantity::SlipAcceleration),
    Reading::OnArc(Quantity::SlipNormal),
    Reading::OnArc(Quantity::SlipTangential),
    Reading::Sliding(Quantity::Coriolis),
    Reading::Links(Quantity::Centre),
    Reading::Rubbing(Quantity::Rub),
    Reading::Point(Quantity::PathRadius),
    Reading::Point(Quantity::Position),
    Reading::Link(Quantity::Angle),
    Reading::Pinned(Quantity::Transmission),
];

/// The short form of the one quantity of motion that has two.
const RUB: (&str, &str) = ("rub(B)", "rubbing speed at pin B; its `radius` stands in `pins`");

impl Reading {
    /// Its row in the table of quantities.
    fn row(self) -> Option<Row> {
        let (point, link) = (PointId(0), LinkId::FRAME);
        let some = match self {
            Self::Point(of) | Self::Pivoted(of) => of(point),
            Self::Points(of) | Self::OneLink(of) => of(point, point),
            Self::Link(of) => of(link),
            Self::Links(of) | Self::Pinned(of) => of(link, link),
            Self::Under(of) | Self::Sliding(of) | Self::OnArc(of) => of(point, link),
            Self::Rubbing(of) => of(point, link, link),
        };
        match some.kind() {
            quantity::Kind::Motion(row) => Some(row),
            quantity::Kind::Force(..) | quantity::Kind::Cycle(_) => None,
        }
    }

    /// The quantity that a name means, if its parentheses hold as many operands as it has: one or two, or two parted by `@`.
    fn read(self, name: &Name<'_, '_, '_>, inside: &str) -> Option<Res<Quantity>> {
        let separator = if matches!(name.head, "I" | "rub") { ',' } else { '/' };
        let two = inside.split_once(separator).map(|(first, second)| (first.trim(), second.trim()));
        let under = inside.split_once('@').map(|(pin, link)| (pin.trim(), link.trim()));
        Some(match (self, two, under) {
            (Self::Point(of), None, None) => name.point(inside).map(of),
            (Self::Pivoted(of), None, None) => name.pivoted(inside).map(of),
            (Self::Link(of), None, None) => name.link(inside).map(of),
            (Self::Points(of), Some((b, a)), _) => name.points(b, a).map(|(b, a)| of(b, a)),
            (Self::OneLink(of), Some((b, a)), _) => name.one_link(b, a).map(|(b, a)| of(b, a)),
            (Self::Links(of), Some((i, j)), _) => name.links(i, j).map(|(i, j)| of(i, j)),
            (Self::Pinned(of), Some((i, j)), _) => name.pinned(i, j).map(|(i, j)| of(i, j)),
            (Self::Under(of), None, Some((pin, link))) => {
                name.sliding(pin, link, false).map(|(pin, link)| of(pin, link))
            }
            (Self::Sliding(of), Some((pin, link)), _) => {
                name.sliding(pin, link, false).map(|(pin, link)| of(pin, link))
            }
            (Self::OnArc(of), Some((pin, link)), _) => {
                name.sliding(pin, link, true).map(|(pin, link)| of(pin, link))
            }
            (Self::Rubbing(of), two, None) => {
                let (pin, links) = two.map_or((inside, None), |(pin, links)| (pin, Some(links)));
                name.rubbing(pin, links).map(|(pin, i, j)| of(pin, i, j))
            }
            _ => return None,
        })
    }
}

/// Every form of a name that a scene may ask for, such as `v(B/A)`, with what it means.
pub fn names_of_quantities() -> impl Iterator<Item = (&'static str, &'static str)> {
    let motion = MOTION.into_iter().filter_map(Reading::row).flat_map(|row| {
        let short = (row.head() == head_of(RUB.0)).then_some(RUB);
        short.into_iter().chain([(row.form, row.meaning)])
    });
    motion.chain(FORCES).chain(CYCLE)
}

/// The letters before the parentheses of all names, each once.
pub(super) fn heads() -> Vec<&'static str> {
    let mut heads = Vec::new();
    for head in names_of_quantities().map(|(form, _)| head_of(form)) {
        if !heads.contains(&head) {
            heads.push(head);
        }
    }
    heads
}

/// The letters before the parenthesis of a name.
pub(super) fn head_of(form: &str) -> &str {
    form.split('(').next().unwrap_or_default()
}

/// The forms of a name by its head, for messages; `None` where nothing is named so.
fn written(head: &str) -> Option<String> {
    let named = names_of_quantities().filter(|(form, _)| head_of(form) == head);
    let forms: Vec<&str> = named.map(|(form, _)| form).collect();
    let (last, rest) = forms.split_last()?;
    Some(if rest.is_empty() { (*last).to_owned() } else { format!("{} or {last}", rest.join(", ")) })
}

/// Reads `find`; without it, everything is asked.
pub(super) fn read(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else {
        draft.mechanism.asked = everything(draft);
        return Ok(());
    };
    for item in value.at_most(ASKED, "a list of names, such as [\"v(B)\", \"omega(3)\"]")? {
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
            Scale::parse(symbol, unit.at)?.must_be(quantity.measure(), unit.at)?.unit()
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

/// The unit in which a quantity is answered where the scene says nothing.
pub(crate) fn default_scale(quantity: &Quantity, scales: &Scales) -> Scale {
    match quantity {
        // A transmission angle is read in degrees whatever the scene counts in.
        Quantity::Transmission(..) => Scale::degrees(),
        _ => scales.bare(quantity.measure()).clone(),
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
        asked.push(Asked { name, quantity, unit: unit(quantity.measure()), method: Method::default() });
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
    /// The letters before the parenthesis.
    head: &'n str,
    draft: &'d Draft<'s>,
}

/// Reads a name, and that what it names exists.
fn parse(name: &str, at: usize, draft: &Draft<'_>) -> Res<Quantity> {
    let unknown = |head: &str| {
        let fault = Fault::new(at, format!("`{name}` is not the name of a quantity"));
        // `omega3`, `vB`: the parentheses are forgotten.
        let letters = head.trim_end_matches(|c: char| c.is_ascii_digit() || c.is_uppercase());
        match written(head).or_else(|| written(letters)) {
            Some(forms) => fault.mend(format!("write {forms}")),
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
    let name = Name { whole: name, at, head, draft };
    let of_head = |reading: &Reading| reading.row().is_some_and(|row| row.head() == head);
    let read = MOTION.into_iter().filter(of_head).find_map(|reading| reading.read(&name, inside));
    read.unwrap_or_else(|| Err(unknown(head)))
}

impl<'n> Name<'n, '_, '_> {
    fn fault(&self, what: impl AsRef<str>) -> Fault {
        Fault::new(self.at, format!("`{}`: {}", self.whole, what.as_ref()))
    }

    /// How it should look.
    fn form(&self) -> String {
        format!("write {}", written(self.head).unwrap_or_default())
    }

    fn point(&self, name: &str) -> Res<PointId> {
        let points = &self.draft.mechanism.points;
        self.draft.point_named(name, self.at).map_err(|_| {
            let fault = self.fault(format!("there is no point `{name}`"));
            if name.parse::<u32>().is_ok() || name.is_empty() {
                return fault.mend(self.form());
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
        Some(match self.head {
            "v" | "a" if pair && guide.is_some() => {
                let head = if self.head == "v" { "slip" } else { "aslip" };
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
                return fault.mend(self.form());
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
        Err(fault.mend(format!("name a second point of its link: {}({name}/…)", self.head)))
    }

    /// Two links with a pin between them.
    fn pinned(&self, first: &str, second: &str) -> Res<(LinkId, LinkId)> {
        let (one, other) = self.links(first, second)?;
        if self.draft.link(one).points.iter().any(|p| self.draft.stands_in(*p, other)) {
            return Ok((one, other));
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

    /// A pin and two of its links.
    fn rubbing(&self, pin: &str, links: Option<&str>) -> Res<(PointId, LinkId, LinkId)> {
        let point = self.point(pin)?;
        let of = &self.draft.mechanism.point(point);
        let pair = match links {
            Some(links) => {
                let (one, other) =
                    links.split_once('/').ok_or_else(|| self.fault("two links rub").mend(self.form()))?;
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
        Ok((point, pair.0, pair.1))
    }
}
