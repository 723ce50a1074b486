//! The frame's points and the links: joints, dimensions, places.

use std::collections::{BTreeMap, HashSet};

use super::diagnostic::{Fault, Res, list};
use super::draft::Draft;
use super::json::{Entry, Fields, Kind, Value};
use super::keys;
use super::units::Measure;
use crate::mechanism::{Form, Given, Link, LinkId, Place, PointId, Sense};

/// The keys that give a link its dimensions; a link takes one of them.
const DIMENSIONS: [&str; 5] = ["length", "line", "sides", "shape", "arms"];

/// What the file says of one link's number.
struct Listed<'v, 'a> {
    at: usize,
    /// Its entry in `links`.
    entry: Option<Fields<'v, 'a>>,
    /// A block that stands only in `slides`: its pin.
    pin: Option<&'v Value<'a>>,
}

/// Reads `fixed`, `links`, the blocks of `slides`, `placed`, `near` and `pins`.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    if let Some(fixed) = scene.get("fixed") {
        for Entry { at, key, value } in fixed.object("places of fixed points, by name")? {
            let point = draft.mention(key, *at)?;
            draft.mechanism.points[point.0].place = Place::Fixed(draft.scales.place(value)?);
            draft.join(LinkId::FRAME, point);
        }
    }
    let listed = listed(scene)?;
    for (&number, link) in &listed {
        let id = draft.add_link(number, link.at)?;
        joints(link, id, draft)?;
    }
    for link in listed.values() {
        known_pin(link, scene, draft)?;
    }
    held_pins(scene, draft)?;
    draft.pin_joints();
    places(scene, draft)?;
    pins(scene, draft)?;
    // Dimensions last: whether a link may do without depends on the places of its points.
    for (index, link) in listed.values().enumerate() {
        if let Some(fields) = &link.entry {
            let id = LinkId(index + 1);
            draft.mechanism.links[id.0].form = form(fields, id, draft)?;
        }
    }
    Ok(())
}

/// All links by ascending number, with the blocks that stand only in `slides`.
fn listed<'v, 'a>(scene: &Fields<'v, 'a>) -> Res<BTreeMap<u32, Listed<'v, 'a>>> {
    let mut listed = BTreeMap::new();
    if let Some(links) = scene.get("links") {
        for Entry { at, key, value } in links.object("links by number")? {
            let number = key.parse::<u32>().ok().filter(|n| n.to_string() == *key);
            let number = match number {
                Some(0 | 1) => {
                    let fault = Fault::new(*at, format!("link {key} cannot be listed: link 1 is the frame"));
                    return Err(fault.mend("its points stand in `fixed`; moving links are numbered from 2"));
                }
                Some(number) => number,
                None => {
                    let fault = Fault::new(*at, format!("`{key}` is not the number of a link"));
                    return Err(fault.mend("links are numbered \"2\", \"3\" and so on; link 1 is the frame"));
                }
            };
            let entry = Fields::of(value, keys::LINK, "a link: {\"joins\": […], …}")?;
            listed.insert(number, Listed { at: value.at, entry: Some(entry), pin: None });
        }
    }
    let slides = scene.get("slides").map(|s| s.list("a list of sliding pairs")).transpose()?;
    for slide in slides.unwrap_or_default() {
        // Whatever is wrong with the pair is said when the pair itself is read.
        let Ok(entries) = slide.object("a sliding pair") else { continue };
        let value = |key: &str| entries.iter().find(|e| e.key == key).map(|e| &e.value);
        if let (Some(block), Some(pin)) = (value("block"), value("pin")) {
            let number = block.whole("the number of a block")?;
            if number < 2 {
                return Err(Fault::new(block.at, format!("a block cannot be link {number}"))
                    .mend("link 1 is the frame; moving links are numbered from 2"));
            }
            listed.entry(number).or_insert(Listed { at: slide.at, entry: None, pin: Some(pin) });
        }
    }
    Ok(listed)
}

/// Puts a link's points into it.
fn joints(link: &Listed<'_, '_>, id: LinkId, draft: &mut Draft<'_>) -> Res<()> {
    if let Some(pin) = link.pin {
        let point = draft.mention(pin.text("the name of a pin")?, pin.at)?;
        draft.join(id, point);
    }
    let Some(fields) = &link.entry else { return Ok(()) };
    let joins =
        fields.need("joins", "it lists the link's joints and points of interest, such as [\"A\", \"B\"]")?;
    let names = joins.list("a list of points, such as [\"A\", \"B\"]")?;
    if names.is_empty() {
        return Err(Fault::new(joins.at, "a link needs at least one joint"));
    }
    let mut seen = HashSet::new();
    for name in names {
        let point = draft.mention(name.text("the name of a point")?, name.at)?;
        if !seen.insert(point) {
            return Err(Fault::new(name.at, format!("`{}` is listed twice", draft.say_point(point))));
        }
        draft.join(id, point);
    }
    Ok(())
}

/// A block that stands only in `slides` is pinned to something, or its pin rides in a second slot; its
/// pin's name is no slip of the pen.
fn known_pin(link: &Listed<'_, '_>, scene: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<()> {
    let Some(pin) = link.pin else { return Ok(()) };
    let point = draft.point(pin)?;
    let name = draft.say_point(point);
    let slides = scene.get("slides").map(|s| s.list("a list of sliding pairs")).transpose()?;
    let rides = |slide: &&Value<'_>| {
        let entries = slide.object("a sliding pair").unwrap_or_default();
        entries.iter().any(|e| e.key == "pin" && e.value.text("the name of a pin").is_ok_and(|n| n == name))
    };
    let slots = slides.unwrap_or_default().iter().filter(rides).count();
    if draft.mechanism.point(point).links.len() > 1 || slots > 1 {
        return Ok(());
    }
    let others = draft.mechanism.points.iter().map(|p| p.name.as_str()).filter(|other| *other != name);
    Err(Fault::new(pin.at, format!("there is no point `{name}`")).known(name, others))
}

/// A pin on two guides that no link has and no block holds belongs to nothing that could be moved or drawn.
fn held_pins(scene: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<()> {
    let slides = scene.get("slides").map(|s| s.list("a list of sliding pairs")).transpose()?;
    let mut bare: Vec<&str> = Vec::new();
    for slide in slides.unwrap_or_default() {
        // Whatever is wrong with the pair is said when the pair itself is read.
        let Ok(entries) = slide.object("a sliding pair") else { continue };
        let Some(pin) = entries.iter().find(|e| e.key == "pin") else { continue };
        let Ok(name) = pin.value.text("the name of a pin") else { continue };
        if draft.mechanism.points.iter().any(|point| point.name == name) {
            continue;
        }
        if bare.contains(&name) {
            let what = format!(
                "the pin {} slides on two guides, but no link and no block has it",
                name.escape_debug()
            );
            return Err(Fault::new(pin.value.at, what).mend(
                "number a block on one of the guides (`\"block\": 5`), or list the pin in a link's `joins`",
            ));
        }
        bare.push(name);
    }
    Ok(())
}

/// Reads `placed` and `near`, and which points `where` states.
fn places(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    draft.anchors.places = vec![None; draft.mechanism.points.len()];
    draft.rooms = vec![0.0; draft.mechanism.points.len()];
    for key in ["placed", "where", "near"] {
        let Some(value) = scene.get(key) else { continue };
        for Entry { at, key: name, value } in value.object("places of moving points, by name")? {
            let point = draft.point_named(name, *at)?;
            if draft.is_fixed(point) {
                let what = format!("`{name}` is a fixed point; `{key}` is for moving ones");
                return Err(Fault::new(*at, what).mend("keep it in one of the two"));
            }
            if key == "where" {
                if draft.is_exact(point) {
                    let what = format!("the place of {name} is given twice: in `placed` and in `where`");
                    return Err(Fault::new(*at, what).mend("keep one of the two"));
                }
                draft.anchors.places[point.0] = Some(value.at);
                draft.mechanism.points[point.0].place = Place::Stated(usize::MAX);
                continue;
            }
            let (place, room) = match (key, &value.kind) {
                ("placed", Kind::Object(_)) => with_room(value, draft)?,
                _ => (draft.scales.place(value)?, 0.0),
            };
            // An exact place needs no rough one beside it.
            if !draft.is_exact(point) {
                draft.anchors.places[point.0] = Some(value.at);
                draft.rooms[point.0] = room;
                draft.mechanism.points[point.0].place = match key {
                    "placed" => Place::Placed(place),
                    _ => Place::Near([place[0].value, place[1].value]),
                };
            }
        }
    }
    Ok(())
}

/// A place that was read off a figure: `{"at": [12.5, 3.1], "within": "0.5 mm"}`, with the radius of its room. A
/// coordinate may be wrong by all of it.
fn with_room(value: &Value<'_>, draft: &Draft<'_>) -> Res<([Given; 2], f64)> {
    let fields = Fields::of(value, keys::PLACED, "a place: [x, y], or {\"at\": [x, y], \"within\": …}")?;
    let at = draft.scales.place(fields.need("at", "the place, such as [12.5, 3.1]")?)?;
    let why =
        "how far the true place may be away, such as \"0.5 mm\"; a place that is exact is written [x, y]";
    let within = draft.scales.positive(fields.need("within", why)?, "the room of a place")?;
    let room = within.value + within.error;
    Ok((at.map(|c| Given::within(c.value, c.error + room)), room))
}

/// Reads `pins`.
fn pins(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(pins) = scene.get("pins") else { return Ok(()) };
    for Entry { at, key, value } in pins.object("journals of pins, by name")? {
        let point = draft.point_named(key, *at)?;
        let fields = Fields::of(value, keys::PIN, "a journal: {\"radius\": …}")?;
        if let Some(carrier) = fields.get("carrier") {
            let link = draft.link_at(carrier)?;
            if !draft.stands_in(point, link) {
                let what = format!("{} does not stand in {}", draft.say_point(point), draft.say(link));
                return Err(Fault::new(carrier.at, what));
            }
            draft.mechanism.forces.carriers.push((point, link));
        }
        let says_more = fields.get("carrier").or(fields.get("circle")).is_some();
        if says_more && fields.get("radius").or(fields.get("diameter")).is_none() {
            continue;
        }
        let journal = match (fields.get("radius"), fields.entry("diameter")) {
            (Some(radius), None) => draft.scales.positive(radius, "the radius")?,
            (None, Some(diameter)) => {
                let diameter = draft.scales.positive(&diameter.value, "the diameter")?;
                diameter.times(0.5)
            }
            (Some(_), Some(diameter)) => {
                return Err(Fault::new(diameter.at, "a pin has a radius or a diameter, not both"));
            }
            (None, None) => {
                return Err(Fault::new(value.at, "`radius` or `diameter` is missing")
                    .mend("say how thick the pin is: \"radius\": …"));
            }
        };
        draft.mechanism.points[point.0].journal = Some(journal);
    }
    Ok(())
}

/// Reads a link's dimensions.
fn form(fields: &Fields<'_, '_>, id: LinkId, draft: &mut Draft<'_>) -> Res<Form> {
    let given: Vec<&Entry<'_>> = DIMENSIONS.iter().filter_map(|key| fields.entry(key)).collect();
    let count = draft.link(id).points.len();
    if let [one, other, ..] = given.as_slice() {
        // The later one in the file is the one too many.
        let (first, second) = if one.at < other.at { (one, other) } else { (other, one) };
        let what = format!("{} has `{}` already; `{}` is one too many", draft.say(id), first.key, second.key);
        return Err(Fault::new(second.at, what).mend("a link takes one kind of dimensions"));
    }
    if fields.get("sides").is_none() {
        fields.refuse(&["turn"], "it gives the turning sense of `sides`")?;
    }
    let Some(entry) = given.first() else { return without_dimension(fields, id, draft) };
    draft.anchors.set_dimension(id, entry.value.at);
    if count == 1 {
        let what = format!("a link with one joint takes no `{}`", entry.key);
        return Err(Fault::new(entry.at, what).mend("list more points in `joins`"));
    }
    let value = &entry.value;
    match entry.key.as_str() {
        "length" => {
            expect_joints(entry, 2, count)?;
            Ok(Form::Length(draft.scales.positive(value, "a length")?))
        }
        "line" => line(value, count, draft),
        "sides" => {
            expect_joints(entry, 3, count)?;
            sides(value, fields.get("turn"), draft)
        }
        "arms" => {
            expect_joints(entry, 3, count)?;
            arms(value, draft)
        }
        _ => shape(value, id, draft),
    }
}

fn expect_joints(entry: &Entry<'_>, wanted: usize, count: usize) -> Res<()> {
    if count == wanted {
        return Ok(());
    }
    let what = format!("`{}` is for links with {wanted} points, this one has {count}", entry.key);
    Err(Fault::new(entry.at, what).mend("for any number of points, take `line` or `shape`"))
}

fn without_dimension(fields: &Fields<'_, '_>, id: LinkId, draft: &Draft<'_>) -> Res<Form> {
    let points = &draft.link(id).points;
    if points.len() == 1 {
        return Ok(Form::Single);
    }
    let free: Vec<&str> =
        points.iter().filter(|p| !draft.is_exact(**p)).map(|p| draft.say_point(*p)).collect();
    if free.is_empty() {
        let mut places = points.iter().map(|p| draft.mechanism.point(*p).place);
        let first = places.next();
        // Of a stated place it is not known yet.
        let same = |place: Place| match (place.exact(), first.and_then(|first| first.exact())) {
            (Some(one), Some(other)) => one.map(|c| c.value) == other.map(|c| c.value),
            _ => false,
        };
        if places.all(same) {
            let what = format!("all points of {} lie in one place: the link has no size", draft.say(id));
            return Err(
                Fault::new(fields.at, what).mend("correct their places, or let the links share one point")
            );
        }
        return Ok(Form::Placed);
    }
    let candidates = match points.len() {
        2 => "`length`, `line` or `shape`",
        3 => "`line`, `sides`, `arms` or `shape`",
        _ => "`line` or `shape`",
    };
    let place = list(&free[..free.len().min(6)]);
    Err(Fault::new(fields.at, format!("the dimensions of {} are missing", draft.say(id)))
        .mend(format!("give {candidates}, or the place of {place} in `placed` or `where`")))
}

/// Exactly so many items.
fn exactly<'v, 'a>(value: &'v Value<'a>, count: usize, expected: &str) -> Res<&'v [Value<'a>]> {
    let items = value.list(expected)?;
    if items.len() == count {
        return Ok(items);
    }
    Err(Fault::new(value.at, format!("expected {expected}, found {} entries", items.len())))
}

fn line(value: &Value<'_>, count: usize, draft: &Draft<'_>) -> Res<Form> {
    let expected = format!("{count} positions along the link, one for each point of `joins`");
    let positions = exactly(value, count, &expected)?
        .iter()
        .map(|item| draft.scales.given(item, Measure::Length))
        .collect::<Res<Vec<Given>>>()?;
    if positions.iter().all(|p| p.value == positions[0].value) {
        return Err(Fault::new(value.at, "all positions are equal: the link has no length"));
    }
    Ok(Form::Line(positions))
}

fn sides(value: &Value<'_>, turn: Option<&Value<'_>>, draft: &Draft<'_>) -> Res<Form> {
    let items = exactly(value, 3, "the three sides 1–2, 2–3 and 3–1")?;
    let mut lengths = [Given::exact(0.0); 3];
    for (length, item) in lengths.iter_mut().zip(items) {
        *length = draft.scales.positive(item, "a side")?;
    }
    for longest in 0..3 {
        let [a, b, c] = [longest + 1, longest + 2, longest].map(|i| lengths[i % 3].value);
        if a + b <= c {
            let say = |metres| draft.scales.say_length(metres);
            let verb = if a + b == c { "only equals" } else { "is less than" };
            let what = format!("the sides do not make a triangle: {} + {} {verb} {}", say(a), say(b), say(c));
            return Err(Fault::new(value.at, what).mend("for three points in line, take `line`"));
        }
    }
    let turn = match turn.map(|t| Ok((t.at, t.text("\"ccw\" or \"cw\"")?))).transpose()? {
        None | Some((_, "ccw")) => Sense::Ccw,
        Some((_, "cw")) => Sense::Cw,
        Some((at, other)) => {
            return Err(Fault::new(at, format!("`{other}` is no turning sense")).known(other, ["ccw", "cw"]));
        }
    };
    let [first_second, second_third, third_first] = lengths;
    Ok(Form::Sides { first_second, second_third, third_first, turn })
}

fn arms(value: &Value<'_>, draft: &Draft<'_>) -> Res<Form> {
    let items = exactly(value, 3, "two arms and the angle between them: [length 1–2, length 1–3, angle]")?;
    Ok(Form::Arms {
        second: draft.scales.positive(&items[0], "an arm")?,
        third: draft.scales.positive(&items[1], "an arm")?,
        angle: draft.scales.given(&items[2], Measure::Angle)?,
    })
}

fn shape(value: &Value<'_>, id: LinkId, draft: &Draft<'_>) -> Res<Form> {
    let entries = value.object("own coordinates by point: {\"A\": [x, y], …}")?;
    let points = &draft.link(id).points;
    let known: Vec<&str> = points.iter().map(|p| draft.say_point(*p)).collect();
    let mut places = vec![None; points.len()];
    for Entry { at, key, value } in entries {
        let Some(index) = known.iter().position(|name| name == key) else {
            let what = format!("`{key}` is not among the points of {}", draft.say(id));
            return Err(Fault::new(*at, what).known(key, known));
        };
        places[index] = Some(draft.scales.place(value)?);
    }
    let missing = places.iter().position(Option::is_none).map(|index| known[index]);
    if let Some(name) = missing {
        return Err(Fault::new(value.at, format!("the coordinates of `{name}` are missing")));
    }
    let places: Vec<[Given; 2]> = places.into_iter().flatten().collect();
    if places.iter().all(|p| (p[0].value, p[1].value) == (places[0][0].value, places[0][1].value)) {
        return Err(Fault::new(value.at, "all points lie in one place: the link has no size"));
    }
    Ok(Form::Shape(places))
}

/// A point's own coordinates in a link that has them from its dimensions, with their error; `None` for
/// the frame and for links dimensioned by placement, whose own coordinates are the world's.
pub(super) fn own_coordinates(link: &Link, index: usize) -> Option<([f64; 2], f64)> {
    if let Some(own) = link.extra_at(index) {
        return Some((own.map(|c| c.value), own[0].error + own[1].error));
    }
    match &link.form {
        Form::Length(length) if index == 0 => Some(([0.0, 0.0], length.error * 0.0)),
        Form::Length(length) => Some(([length.value, 0.0], length.error)),
        Form::Line(positions) => positions.get(index).map(|p| ([p.value, 0.0], p.error)),
        Form::Shape(places) => places.get(index).map(|p| ([p[0].value, p[1].value], p[0].error + p[1].error)),
        Form::Sides { first_second, second_third, third_first, turn } => {
            let [c, a, b] = [first_second, second_third, third_first].map(|side| side.value);
            match index {
                0 => Some(([0.0, 0.0], 0.0)),
                1 => Some(([c, 0.0], first_second.error)),
                _ => {
                    let x = ((b - a) * (b + a) + c * c) / (2.0 * c);
                    let y = ((b - x) * (b + x)).max(0.0).sqrt();
                    let y = if *turn == Sense::Ccw { y } else { -y };
                    Some(([x, y], first_second.error + second_third.error + third_first.error))
                }
            }
        }
        Form::Arms { second, third, angle } => match index {
            0 => Some(([0.0, 0.0], 0.0)),
            1 => Some(([second.value, 0.0], second.error)),
            _ => {
                let (sin, cos) = libm::sincos(angle.value);
                let error = third.error + third.value * angle.error;
                Some(([third.value * cos, third.value * sin], error))
            }
        },
        Form::Single => Some(([0.0, 0.0], 0.0)),
        Form::Placed => None,
    }
}

/// Where in the link a point stands.
pub(super) fn index_of(draft: &Draft<'_>, link: LinkId, point: PointId) -> Option<usize> {
    draft.link(link).points.iter().position(|p| *p == point)
}
