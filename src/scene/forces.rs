//! What acts on the links besides their pairs: `gravity`, `masses`, `loads`, `springs`.

use super::cycle::curve_of_load;
use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::json::{Entry, Fields, Kind, Value};
use super::keys;
use super::links::{index_of, own_coordinates};
use super::rolls::free_letters;
use super::units::{Measure, short};
use crate::limits::ASKED;
use crate::mechanism::curve::Curve;
use crate::mechanism::force::{
    Area, Gravity, Heaviness, Inertia, Load, LoadKind, Mass, Pointing, Pressure, Size, Spring, SpringKind,
    SpringLaw,
};
use crate::mechanism::{Form, Given, Input, Link, LinkId, Place, PointId};

/// What is written where a number is to be found.
const SOUGHT: &str = "?";

/// Gives a point of its link to every pair of own coordinates in `masses`, `loads` and `springs`.
pub(super) fn spots(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    draft.loads_count_turns = has_curves(scene);
    let (blocks, rolling) = (blocks(scene, draft), rolling(scene, draft));
    let mut sliding = in_guides(scene, draft);
    sliding.retain(|link| !rolling.contains(link));
    let spot = |value: Option<&Value<'_>>, link: LinkId, name: &str, draft: &mut Draft<'_>| {
        spot(value, link, name, [&blocks, &sliding, &rolling], draft)
    };
    if let Some(masses) = scene.get("masses") {
        for Entry { key, value, .. } in masses.object("masses, by number of the link")? {
            let Ok(fields) = Fields::of(value, keys::MASS, "a mass") else { continue };
            let Some(link) = key.parse().ok().and_then(|n| draft.link_of(n, value.at).ok()) else { continue };
            for place in ["at", "about"] {
                spot(fields.get(place), link, &format!("G{key}"), draft)?;
            }
        }
    }
    let list =
        |key: &str| scene.get(key).map(|v| v.list("a list")).transpose().map(Option::unwrap_or_default);
    for (index, item) in list("loads")?.iter().enumerate() {
        let Ok(fields) = Fields::of(item, keys::LOAD, "a load") else { continue };
        let Some(link) = fields.get("on").and_then(|on| draft.link_at(on).ok()) else { continue };
        spot(fields.get("at"), link, &format!("L{}", index + 1), draft)?;
    }
    for (index, item) in list("springs")?.iter().enumerate() {
        let Ok(fields) = Fields::of(item, keys::SPRING, "a spring") else { continue };
        let Some(Kind::List(ends)) = fields.get("between").map(|ends| &ends.kind) else { continue };
        for (end, name) in ends.iter().zip(["K", "H"]) {
            let Ok(fields) = Fields::of(end, keys::SPRING_END, "an end") else { continue };
            let Some(link) = fields.get("link").and_then(|link| draft.link_at(link).ok()) else { continue };
            spot(fields.get("at"), link, &format!("{name}{}", index + 1), draft)?;
        }
    }
    Ok(())
}

/// Whether the size of a load is a curve over the angle of the input.
fn has_curves(scene: &Fields<'_, '_>) -> bool {
    let Some(Kind::List(loads)) = scene.get("loads").map(|loads| &loads.kind) else { return false };
    let is_curve = |item: &Value<'_>| match &item.kind {
        Kind::Object(entries) => entries.iter().any(|entry| {
            ["force", "torque", "pressure"].contains(&entry.key.as_str())
                && matches!(entry.value.kind, Kind::Object(_))
        }),
        _ => false,
    };
    loads.iter().any(is_curve)
}

/// The blocks of `slides` that slide along straight guides, each of one sliding pair.
fn blocks(scene: &Fields<'_, '_>, draft: &Draft<'_>) -> Vec<LinkId> {
    let Some(Kind::List(slides)) = scene.get("slides").map(|slides| &slides.kind) else { return Vec::new() };
    let on_arc = |fields: &Fields<'_, '_>| match fields.get("on").map(|on| &on.kind) {
        Some(Kind::Object(entries)) => entries.iter().any(|entry| entry.key == "centre"),
        _ => false,
    };
    let number = |item: &Value<'_>| {
        let fields = Fields::of(item, keys::SLIDE, "a sliding pair").ok()?;
        let block = fields.get("block").and_then(|block| draft.link_at(block).ok())?;
        Some((block, on_arc(&fields)))
    };
    let all: Vec<(LinkId, bool)> = slides.iter().filter_map(number).collect();
    let once = |link: LinkId| all.iter().filter(|(other, _)| *other == link).count() == 1;
    all.iter().filter(|(link, arc)| once(*link) && !arc).map(|(link, _)| *link).collect()
}

/// The links that slide themselves, or carry the guide of a driven slide: in which directions their own
/// coordinates lie is told by their guides, whatever joints they have. On which side of its carrier something rides that
/// nobody drives is left to the assembly.
fn in_guides(scene: &Fields<'_, '_>, draft: &Draft<'_>) -> Vec<LinkId> {
    let items = |key: &str| match scene.get(key).map(|list| &list.kind) {
        Some(Kind::List(items)) => &items[..],
        _ => &[],
    };
    let text = |value: &Value<'_>| match &value.kind {
        Kind::Number(digits) => Some((*digits).to_owned()),
        Kind::Text(text) => Some(text.clone()),
        _ => None,
    };
    let inputs = scene.get("input").into_iter().chain(items("inputs"));
    let driven: Vec<String> = inputs
        .filter_map(|input| match &input.kind {
            Kind::Object(entries) => entries.iter().find(|entry| entry.key == "slide"),
            _ => None,
        })
        .filter_map(|entry| text(&entry.value))
        .collect();
    let mut all = Vec::new();
    for item in items("slides") {
        let Ok(fields) = Fields::of(item, keys::SLIDE, "a sliding pair") else { continue };
        let guide = fields.get("on").and_then(|on| match &on.kind {
            Kind::Object(entries) => {
                entries.iter().find(|entry| entry.key == "link").map(|entry| &entry.value)
            }
            _ => None,
        });
        let names = ["link", "block", "pin"].into_iter().filter_map(|key| fields.get(key));
        let is_driven = names.filter_map(text).any(|name| driven.contains(&name));
        let links = [fields.get("link"), guide.filter(|_| is_driven)].into_iter().flatten();
        all.extend(links.filter_map(|link| draft.link_at(link).ok()));
    }
    all
}

/// The links of rolling pairs.
fn rolling(scene: &Fields<'_, '_>, draft: &Draft<'_>) -> Vec<LinkId> {
    let Some(Kind::List(items)) = scene.get("rolls").map(|list| &list.kind) else { return Vec::new() };
    let mut all = Vec::new();
    for item in items {
        let Kind::Object(entries) = &item.kind else { continue };
        let bodies = entries.iter().find(|entry| entry.key == "links").map(|entry| &entry.value.kind);
        let Some(Kind::List(bodies)) = bodies else { continue };
        all.extend(bodies.iter().filter_map(|body| draft.link_at(body).ok()));
    }
    all
}

/// A point for own coordinates, by this name where nobody has it. A block that gets one slides as a link does from then
/// on, its x-axis along its guide: it is the same body in the same pairs.
fn spot(
    value: Option<&Value<'_>>,
    link: LinkId,
    name: &str,
    [blocks, sliding, rolling]: [&[LinkId]; 3],
    draft: &mut Draft<'_>,
) -> Res<()> {
    let Some(value) = value.filter(|value| matches!(value.kind, Kind::List(_))) else { return Ok(()) };
    let own = draft.scales.place(value)?;
    let form = draft.link(link).form.clone();
    let worldly = link == LinkId::FRAME || form == Form::Placed;
    if form == Form::Single && !worldly {
        let only = draft.link(link).points[0];
        if own.iter().all(|c| c.value == 0.0) {
            draft.spots.insert(value.at, only);
            return Ok(());
        }
        if rolling.contains(&link) {
            let what = format!(
                "this version does not do own coordinates of {}, which has one joint and rolls",
                draft.say(link)
            );
            return Err(Fault::new(value.at, what).mend(format!("name its joint, {}", draft.say_point(only))));
        }
        if blocks.contains(&link) {
            draft.wide_blocks.push(link);
        }
        // Any other link of one joint has its own axes by its input, by the rider of its guide, or as the world's.
        if blocks.contains(&link) || sliding.contains(&link) {
            draft.mechanism.links[link.0].form = Form::Shape(vec![[Given::exact(0.0); 2]]);
        }
    }
    let number = name.trim_start_matches(|c: char| !c.is_ascii_digit());
    let letters = &name[..name.len() - number.len()];
    let taken = |own: &str| draft.point_named(&format!("{own}{number}"), value.at).is_ok();
    let free = format!("{}{number}", free_letters(letters, taken));
    let point = draft.mention(&free, value.at)?;
    draft.join(link, point);
    if draft.anchors.places.is_empty() {
        draft.anchors.places = vec![None; draft.mechanism.points.len() - 1];
    }
    draft.anchors.places.resize(draft.mechanism.points.len(), None);
    draft.rooms.resize(draft.mechanism.points.len(), 0.0);
    if link == LinkId::FRAME {
        draft.mechanism.points[point.0].place = Place::Fixed(own);
    } else if worldly {
        draft.mechanism.points[point.0].place = Place::Placed(own);
    } else {
        draft.mechanism.links[link.0].extra.push(own);
    }
    draft.spots.insert(value.at, point);
    Ok(())
}

/// Whether a link has no joint but its first, whatever points it has by own coordinates besides.
fn has_one_joint(link: LinkId, draft: &Draft<'_>) -> bool {
    let Link { form, points, extra, .. } = draft.link(link);
    match form {
        Form::Single => true,
        Form::Placed => false,
        // A link that slides has its own axes by its guide as soon as it has a point by own coordinates.
        _ => draft.wide_blocks.contains(&link) || points.len() == extra.len() + 1,
    }
}

/// A point of a link, by name or by own coordinates.
fn place(value: &Value<'_>, link: LinkId, draft: &Draft<'_>) -> Res<PointId> {
    match (&value.kind, draft.spots.get(&value.at)) {
        (_, Some(point)) => Ok(*point),
        (Kind::Text(_), None) => draft.point_in(value, link),
        _ => Err(value.unexpected("a point of the link or own coordinates [x, y]")),
    }
}

/// Reads `gravity`, `masses`, `loads` and `springs`.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    gravity(scene.get("gravity"), draft)?;
    masses(scene.get("masses"), draft)?;
    loads(scene, draft)?;
    springs(scene.get("springs"), draft)?;
    super::spin::read(scene, draft)?;
    if draft.mechanism.forces.is_empty() {
        return Ok(());
    }
    super::rolls::pressures(scene, draft)?;
    super::friction::read(scene, draft)?;
    let sought = draft.mechanism.named_sought().len();
    let freedoms = draft.mechanism.inputs.len();
    if sought > 0 && sought != freedoms {
        let at = scene.entry("loads").or(scene.entry("springs")).map_or(0, |entry| entry.at);
        let plural = if freedoms == 1 { "" } else { "s" };
        let what =
            format!("{sought} unknowns `?` are sought, but the mechanism has {freedoms} input{plural}");
        return Err(Fault::new(at, what).mend(
            "seek as many as there are degrees of freedom, or none: then the effort at every input is sought",
        ));
    }
    Ok(())
}

fn gravity(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else { return Ok(()) };
    let fields = Fields::of(value, keys::GRAVITY, "gravity: {}, or {\"g\": …, \"direction\": …}")?;
    let g = match fields.get("g") {
        Some(g) => positive(g, Measure::Acceleration, "g", draft)?,
        None => Gravity::USUAL,
    };
    let direction = fields.get("direction").map(|d| draft.scales.given(d, Measure::Angle)).transpose()?;
    let acts = fields.get("acts").map(Value::bool).transpose()?.unwrap_or(true);
    draft.mechanism.forces.gravity = Gravity { g, direction: direction.unwrap_or(Gravity::DOWN), acts };
    Ok(())
}

/// A number greater than zero.
fn positive(value: &Value<'_>, measure: Measure, what: &str, draft: &Draft<'_>) -> Res<Given> {
    let given = draft.scales.given(value, measure)?;
    if given.value > 0.0 {
        return Ok(given);
    }
    Err(Fault::new(value.at, format!("{what} must be greater than zero")))
}

fn masses(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else { return Ok(()) };
    let mut masses = Vec::new();
    for Entry { at, key, value } in value.object("masses, by number of the link")? {
        let number = key.parse::<u32>().ok().filter(|n| n.to_string() == *key);
        let number = number.ok_or_else(|| Fault::new(*at, format!("`{key}` is not the number of a link")))?;
        let link = draft.link_of(number, *at)?;
        if link == LinkId::FRAME {
            return Err(Fault::new(*at, "link 1 is the frame: its mass changes nothing").mend("leave it out"));
        }
        masses.push(mass(value, link, draft)?);
    }
    masses.sort_by_key(|mass| mass.link);
    draft.mechanism.forces.masses = masses;
    Ok(())
}

fn mass(value: &Value<'_>, link: LinkId, draft: &Draft<'_>) -> Res<Mass> {
    let fields = Fields::of(value, keys::MASS, "a mass: {\"weight\": …, \"at\": …}")?;
    let heaviness = match (fields.get("mass"), fields.entry("weight")) {
        (Some(mass), None) => Heaviness::Mass(positive(mass, Measure::Mass, "a mass", draft)?),
        (None, Some(weight)) => {
            Heaviness::Weight(positive(&weight.value, Measure::Force, "a weight", draft)?)
        }
        (Some(_), Some(weight)) => {
            return Err(Fault::new(weight.at, "a link has a `mass` or a `weight`, not both"));
        }
        (None, None) => Heaviness::None,
    };
    let inertia = match (fields.get("inertia"), fields.entry("gyration")) {
        (Some(inertia), None) => {
            let given = positive(inertia, Measure::Inertia, "a moment of inertia", draft)?;
            match fields.get("about") {
                Some(about) => Inertia::About(place(about, link, draft)?, given),
                None => Inertia::Central(given),
            }
        }
        (None, gyration) => {
            fields.refuse(&["about"], "it says about which point `inertia` is given")?;
            match gyration {
                Some(radius) => Inertia::Gyration(positive(
                    &radius.value,
                    Measure::Length,
                    "a radius of gyration",
                    draft,
                )?),
                None => Inertia::Point,
            }
        }
        (Some(_), Some(gyration)) => {
            return Err(Fault::new(gyration.at, "a link has `inertia` or `gyration`, not both"));
        }
    };
    if heaviness == Heaviness::None && !matches!(inertia, Inertia::Central(_) | Inertia::About(..)) {
        return Err(
            Fault::new(value.at, "`mass` or `weight` is missing").mend("`inertia` alone would be a flywheel")
        );
    }
    let points = &draft.link(link).points;
    let centre = match (fields.get("at"), &points[..]) {
        (Some(at), _) => place(at, link, draft)?,
        (None, [only]) => *only,
        (None, [pin, ..]) if has_one_joint(link, draft) => *pin,
        // A flywheel turns about whatever point it likes.
        (None, [first, ..]) if heaviness == Heaviness::None => *first,
        _ => {
            let what = format!("the mass centre of {} is missing", draft.say(link));
            return Err(Fault::new(value.at, what)
                .mend("name it in `at`: a point of the link, or own coordinates [x, y]"));
        }
    };
    let mass = Mass { link, heaviness, centre, inertia };
    if let (Inertia::About(point, given), Some(least)) = (inertia, moved_inertia(&mass, draft))
        && given.value < least
    {
        let about = draft.say_point(point);
        let what =
            format!("no link has so little inertia about {about}: M d² alone is {} kg m²", short(least));
        let at = fields.get("inertia").map_or(value.at, |inertia| inertia.at);
        return Err(Fault::new(at, what).mend("leave `about` out where it is given about the mass centre"));
    }
    Ok(mass)
}

/// M d² from the mass centre to the point about which the inertia is given, where the link's own coordinates tell it.
fn moved_inertia(mass: &Mass, draft: &Draft<'_>) -> Option<f64> {
    let Inertia::About(point, _) = mass.inertia else { return None };
    let g = draft.mechanism.forces.gravity.g.value;
    let kilograms = match mass.heaviness {
        Heaviness::Mass(mass) => mass.value,
        Heaviness::Weight(weight) => weight.value / g,
        Heaviness::None => return None,
    };
    let own = |point: PointId| -> Option<[f64; 2]> {
        let link = draft.link(mass.link);
        let by_places = draft.mechanism.point(point).place.exact().map(|place| place.map(|c| c.value));
        match link.form {
            Form::Placed => by_places,
            _ => own_coordinates(link, index_of(draft, mass.link, point)?).map(|(own, _)| own),
        }
    };
    let (a, b) = (own(mass.centre)?, own(point)?);
    let away = libm::hypot(a[0] - b[0], a[1] - b[1]);
    Some(kilograms * away * away)
}

/// A number, or `"?"`.
fn size(value: &Value<'_>, measure: Measure, draft: &Draft<'_>) -> Res<Size> {
    match &value.kind {
        Kind::Text(text) if text.trim() == SOUGHT => Ok(Size::Sought),
        _ => Ok(Size::Given(draft.scales.given(value, measure)?)),
    }
}

/// The sizes of loads that change with the angle of the first input, while they are read.
struct Curves<'a, 's> {
    scene: &'a Fields<'a, 's>,
    read: Vec<Curve>,
}

impl Curves<'_, '_> {
    /// A number, `"?"`, or a curve.
    fn size(&mut self, value: &Value<'_>, measure: Measure, draft: &Draft<'_>) -> Res<Size> {
        if !matches!(value.kind, Kind::Object(_)) {
            return size(value, measure, draft);
        }
        self.read.push(curve_of_load(value, measure, self.scene, draft)?);
        Ok(Size::Curve(self.read.len() - 1))
    }
}

fn loads(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = scene.get("loads") else { return Ok(()) };
    let mut curves = Curves { scene, read: Vec::new() };
    let mut loads: Vec<Load> = Vec::new();
    for (index, item) in value.at_most(ASKED, "a list of loads")?.iter().enumerate() {
        let fields = Fields::of(item, keys::LOAD, "a load: {\"on\": 4, \"at\": \"C\", \"force\": …}")?;
        let name = name(&fields, &format!("load {}", index + 1), draft)?;
        if loads.iter().any(|other| other.name == name) {
            return Err(Fault::new(item.at, format!("there is a load `{name}` already")));
        }
        let on = fields.need("on", "the number of the loaded link")?;
        let link = draft.link_at(on)?;
        if link == LinkId::FRAME {
            return Err(Fault::new(on.at, "link 1 is the frame: a load on it changes nothing")
                .mend("name the link on which it acts"));
        }
        let kind = load(&fields, link, &mut curves, draft)?;
        loads.push(Load { name, link, kind });
    }
    draft.mechanism.forces.loads = loads;
    draft.mechanism.forces.curves = curves.read;
    Ok(())
}

fn name(fields: &Fields<'_, '_>, otherwise: &str, draft: &Draft<'_>) -> Res<String> {
    let Some(value) = fields.get("name") else { return Ok(otherwise.to_owned()) };
    let name = value.text("a name")?.trim();
    let fine = |c: char| !c.is_whitespace() && !c.is_control() && !"/,()\"`@.".contains(c);
    let letter = name.chars().next().is_some_and(char::is_alphabetic);
    if !letter || !name.chars().all(fine) || name.len() > 64 {
        return Err(Fault::new(value.at, format!("`{}` cannot name a load", name.escape_debug())).mend(
            "a name begins with a letter and has no blank, slash, comma, stop or parenthesis, such as `P`",
        ));
    }
    let _ = draft;
    Ok(name.to_owned())
}

fn load(
    fields: &Fields<'_, '_>,
    link: LinkId,
    curves: &mut Curves<'_, '_>,
    draft: &Draft<'_>,
) -> Res<LoadKind> {
    let keys = ["force", "torque", "pressure"];
    let given: Vec<&Entry<'_>> = keys.iter().filter_map(|key| fields.entry(key)).collect();
    let entry = match given[..] {
        [one] => one,
        [_, other, ..] => {
            return Err(Fault::new(other.at, format!("`{}` is one size too many", other.key))
                .mend("a load is one of `force`, `torque` and `pressure`"));
        }
        [] => {
            return Err(Fault::new(fields.at, "the size of the load is missing")
                .mend("give `force`, `torque`, or `pressure` with `area` or `bore`"));
        }
    };
    if entry.key != "pressure" {
        fields.refuse(&["area", "bore", "rod"], "it goes with `pressure`")?;
    }
    if entry.key == "torque" {
        fields.refuse(&["at", "in"], "a torque acts on the whole link")?;
        let with_motion = match fields.get("direction") {
            None => None,
            Some(direction) => match direction.text("\"with\" or \"against\"")? {
                "with" => Some(true),
                "against" => Some(false),
                other => {
                    return Err(Fault::new(direction.at, format!("`{other}` is no direction of a torque"))
                        .known(other, ["with", "against"]));
                }
            },
        };
        return Ok(LoadKind::Torque {
            size: curves.size(&entry.value, Measure::Torque, draft)?,
            with_motion,
        });
    }
    let at = match fields.get("at") {
        Some(at) => place(at, link, draft)?,
        None => match draft.link(link).points[..] {
            [only] => only,
            [pin, ..] if has_one_joint(link, draft) => pin,
            _ => {
                return Err(Fault::new(
                    fields.at,
                    format!("where on {} the load acts is missing", draft.say(link)),
                )
                .mend("name the point in `at`, or give own coordinates [x, y]"));
            }
        },
    };
    if let (Kind::List(parts), "force") = (&entry.value.kind, entry.key.as_str()) {
        fields.refuse(&["direction"], "components say where a force points")?;
        let [x, y] = &parts[..] else {
            return Err(Fault::new(
                entry.value.at,
                format!("expected two components, found {}", parts.len()),
            ));
        };
        let parts = [draft.scales.given(x, Measure::Force)?, draft.scales.given(y, Measure::Force)?];
        let of = fields.get("in").map_or(Ok(LinkId::FRAME), |link| draft.link_at(link))?;
        return Ok(LoadKind::Vector { at, parts, of });
    }
    fields.refuse(&["in"], "it says in whose coordinates the components [x, y] of a force are")?;
    let size = match entry.key.as_str() {
        "pressure" => {
            let pressure = match curves.size(&entry.value, Measure::Pressure, draft)? {
                Size::Given(pressure) => Pressure::Given(pressure),
                Size::Curve(curve) => Pressure::Curve(curve),
                _ => {
                    return Err(
                        Fault::new(entry.value.at, "a pressure cannot be sought").mend("seek a `force`")
                    );
                }
            };
            Size::Pressure { pressure, area: area(fields, draft)? }
        }
        _ => curves.size(&entry.value, Measure::Force, draft)?,
    };
    let pointing = match fields.get("direction") {
        None => Pointing::World(Given::exact(0.0)),
        Some(value) => pointing(value, draft)?,
    };
    if size == Size::Sought && matches!(pointing, Pointing::Motion { .. }) {
        let value = fields.get("direction").map_or(fields.at, |value| value.at);
        return Err(Fault::new(value, "a sought force has a stated line, not that of a motion")
            .mend("give `direction` as an angle or between two points"));
    }
    Ok(LoadKind::Force { at, size, pointing })
}

fn area(fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<Area> {
    match (fields.get("area"), fields.entry("bore")) {
        (Some(area), None) => {
            fields.refuse(&["rod"], "it goes with `bore`")?;
            Ok(Area::Given(positive(area, Measure::Area, "an area", draft)?))
        }
        (None, Some(bore)) => {
            let bore_size = draft.scales.positive(&bore.value, "a bore")?;
            let rod = fields.get("rod").map(|rod| draft.scales.positive(rod, "a rod")).transpose()?;
            if rod.is_some_and(|rod| rod.value >= bore_size.value) {
                return Err(Fault::new(bore.at, "the rod is as thick as the bore"));
            }
            Ok(Area::Bore { bore: bore_size, rod })
        }
        (Some(_), Some(bore)) => {
            Err(Fault::new(bore.at, "a pressure acts on an `area` or a `bore`, not both"))
        }
        (None, None) => Err(Fault::new(fields.at, "on what the pressure acts is missing")
            .mend("give `area`, or `bore` (with `rod`)")),
    }
}

fn pointing(value: &Value<'_>, draft: &Draft<'_>) -> Res<Pointing> {
    match &value.kind {
        Kind::Text(text) if text.trim() == "against" => Ok(Pointing::Motion { with: false }),
        Kind::Text(text) if text.trim() == "with" => Ok(Pointing::Motion { with: true }),
        Kind::Text(text) if text.trim().starts_with(|c: char| c.is_ascii_alphabetic()) => {
            let fault = Fault::new(value.at, format!("`{text}` is no direction"))
                .mend("write an angle, `with` or `against`, or {\"from\": …, \"to\": …}");
            Err(match super::diagnostic::nearest(text.trim(), &["with", "against"]) {
                Some(near) => fault.mend(format!("did you mean `{near}`?")),
                None => fault,
            })
        }
        Kind::Object(_) => {
            let fields = Fields::of(value, keys::POINTING, "a direction: {\"from\": …, \"to\": …}")?;
            let angle = |key: &str| -> Res<Given> {
                fields.get(key).map_or(Ok(Given::exact(0.0)), |v| draft.scales.given(v, Measure::Angle))
            };
            if let Some(link) = fields.get("link") {
                fields.refuse(&["from", "to", "turned"], "`link` and `angle` say the direction already")?;
                return Ok(Pointing::Own { link: draft.link_at(link)?, angle: angle("angle")? });
            }
            fields.refuse(&["angle"], "it goes with `link`; between two points a direction is `turned`")?;
            let from = draft.point(fields.need("from", "the point from which it points")?)?;
            let end = fields.need("to", "the point towards which it points")?;
            let to = draft.point(end)?;
            if from == to {
                return Err(Fault::new(end.at, "the two points are one"));
            }
            Ok(Pointing::Between { from, to, turned: angle("turned")? })
        }
        _ => Ok(Pointing::World(draft.scales.given(value, Measure::Angle)?)),
    }
}

fn springs(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else { return Ok(()) };
    let mut springs: Vec<Spring> = Vec::new();
    for (index, item) in value.at_most(ASKED, "a list of springs")?.iter().enumerate() {
        let fields = Fields::of(item, keys::SPRING, "a spring: {\"between\": […], \"stiffness\": …}")?;
        let name = name(&fields, &format!("spring {}", index + 1), draft)?;
        if springs.iter().any(|other| other.name == name) {
            return Err(Fault::new(item.at, format!("there is a spring `{name}` already")));
        }
        let kind = match (fields.get("between"), fields.entry("links")) {
            (Some(between), None) => SpringKind::Pull(ends(between, draft)?),
            (None, Some(links)) => {
                let expected = "the numbers of two links, such as [1, 4]";
                match links.value.list(expected)? {
                    [one, other] => {
                        let pair = [draft.link_at(one)?, draft.link_at(other)?];
                        if pair[0] == pair[1] {
                            return Err(Fault::new(other.at, "the two links are one"));
                        }
                        SpringKind::Torsion(pair)
                    }
                    _ => return Err(links.value.unexpected(expected)),
                }
            }
            (Some(_), Some(links)) => {
                return Err(Fault::new(links.at, "a spring has `between` or `links`, not both"));
            }
            (None, None) => {
                return Err(Fault::new(item.at, "between what the spring acts is missing")
                    .mend("give `between` with two places, or `links` for a torsion spring"));
            }
        };
        let turning = matches!(kind, SpringKind::Torsion(_));
        let law = match (fields.get("stiffness"), fields.entry("force")) {
            (Some(stiffness), None) => {
                let measure = if turning { Measure::TurningStiffness } else { Measure::Stiffness };
                let stiffness = match size(stiffness, measure, draft)? {
                    Size::Given(_) => Size::Given(positive(stiffness, measure, "a stiffness", draft)?),
                    sought => sought,
                };
                let what = match turning {
                    true => "the angle of the second link against the first without load",
                    false => "the length of the spring without load",
                };
                let free = fields.need("free", what)?;
                let measure = if turning { Measure::Angle } else { Measure::Length };
                SpringLaw::Stiffness { stiffness, free: draft.scales.given(free, measure)? }
            }
            (None, Some(force)) => {
                fields.refuse(&["free"], "`force` says how hard it pulls now")?;
                let measure = if turning { Measure::Torque } else { Measure::Force };
                SpringLaw::Force(size(&force.value, measure, draft)?)
            }
            (Some(_), Some(force)) => {
                return Err(Fault::new(
                    force.at,
                    "a spring has `stiffness` and `free`, or `force`, not both",
                ));
            }
            (None, None) => {
                return Err(Fault::new(item.at, "how hard the spring pulls is missing")
                    .mend("give `stiffness` and `free`, or `force`"));
            }
        };
        springs.push(Spring { name, kind, law, wound: 0.0 });
    }
    draft.mechanism.forces.springs = springs;
    Ok(())
}

fn ends(value: &Value<'_>, draft: &Draft<'_>) -> Res<[(LinkId, PointId); 2]> {
    let expected = "two places: [{\"link\": 4, \"at\": \"C\"}, {\"link\": 1, \"at\": [300, 200]}]";
    let [first, second] = value.list(expected)? else { return Err(value.unexpected(expected)) };
    let end = |value: &Value<'_>| -> Res<(LinkId, PointId)> {
        let fields = Fields::of(value, keys::SPRING_END, "a place: {\"link\": 4, \"at\": \"C\"}")?;
        let link = draft.link_at(fields.need("link", "the number of the link")?)?;
        let at = fields.need("at", "the point of the link, or own coordinates [x, y]")?;
        Ok((link, place(at, link, draft)?))
    };
    let ends = [end(first)?, end(second)?];
    if ends[0].0 == ends[1].0 || ends[0].1 == ends[1].1 {
        return Err(Fault::new(second.at, "a spring acts between two points of two links"));
    }
    Ok(ends)
}

/// The input that drives this link by its angle.
pub(super) fn effort_of_link(link: LinkId, draft: &Draft<'_>) -> Option<usize> {
    (0..draft.mechanism.inputs.len()).find(|input| draft.mechanism.driven_link(*input) == Some(link))
}

/// The input that drives this sliding pair.
pub(super) fn effort_of_slide(pair: usize, draft: &Draft<'_>) -> Option<usize> {
    let drives = |input: &Input| matches!(input, Input::Slide { slide, .. } if *slide == pair);
    draft.mechanism.inputs.iter().position(drives)
}
