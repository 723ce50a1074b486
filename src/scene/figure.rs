//! Places by what a figure states: `where`, two loci to a point.
//!
//! Nothing is drawn or solved here. What is found out is structure: from which points each place is stated, in which
//! order they stand, and whether dimensions and guides hold the point besides.

use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::guides::path;
use super::json::{Entry, Fields, Kind, Value};
use super::keys;
use super::units::Measure;
use crate::mechanism::statement::{Locus, Standing, Statement};
use crate::mechanism::{
    Direction, Form, Given, Guide, GuidePoint, Input, LinkId, Path, Place, PointId, Rider, Roll,
};

/// Rides on rides on rides are followed so deep.
const DEEPEST: usize = 8;

/// How a locus is written.
const FORMS: &str = "a locus is {\"from\", \"distance\"}, {\"from\", \"direction\"}, {\"from\", \"square_to\"}, \
                     {\"sees\", \"at\"} or {\"on\"}";

/// One point of `where`.
struct Stated {
    at: usize,
    point: PointId,
    loci: [Locus; 2],
    /// It stands by its driven link; others are stated from it.
    driven: bool,
}

/// Reads `where`, once links, pairs and inputs are known and the placed points are settled.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = scene.get("where") else { return Ok(()) };
    let near = scene.get("near").map(|near| near.object("places by name")).transpose()?.unwrap_or_default();
    let mut open = Vec::new();
    for Entry { at, key, value } in value.object("two loci for each point, by name")? {
        let point = draft.point_named(key, *at)?;
        open.push(Stated { at: value.at, point, loci: loci(value, point, draft)?, driven: false });
    }
    // What is stated from a placed point that follows from dimensions is stated from where these put it.
    for from in open.iter().flat_map(hangs_on).collect::<Vec<_>>() {
        let settled = draft.settled.iter().find(|(point, _)| *point == from);
        if let (Some(&(_, at)), false) = (settled, open.iter().any(|stated| stated.point == from)) {
            draft.mechanism.points[from.0].place = Place::Placed(at);
        }
    }
    for statement in in_order(open, draft)? {
        let Stated { point, loci, driven, .. } = statement;
        if driven {
            let standing = Standing::Driven;
            draft.mechanism.statements.push(Statement { point, loci, near: None, standing });
            continue;
        }
        let name = draft.say_point(point);
        let near = near.iter().find(|entry| entry.key == name).map(|entry| draft.scales.place(&entry.value));
        let near = near.transpose()?.map(|place| place.map(|c| c.value));
        let standing = standing(point, &loci, draft);
        draft.mechanism.points[point.0].place = Place::Stated(draft.mechanism.statements.len());
        draft.mechanism.statements.push(Statement { point, loci, near, standing });
    }
    Ok(())
}

/// The two loci of a point.
fn loci(value: &Value<'_>, point: PointId, draft: &Draft<'_>) -> Res<[Locus; 2]> {
    let name = draft.say_point(point);
    let items = match &value.kind {
        Kind::List(items) => items.as_slice(),
        Kind::Object(_) => std::slice::from_ref(value),
        _ => return Err(value.unexpected("a list of two loci").mend(FORMS)),
    };
    let mut found: Vec<(Locus, usize)> = Vec::new();
    for item in items {
        for locus in read_locus(item, point, draft)? {
            if found.len() == 2 {
                let what = format!("{name} stands by two loci; this one is too many");
                return Err(Fault::new(item.at, what).mend(format!("leave out one of those of {name}")));
            }
            found.push((locus, item.at));
        }
    }
    match found.as_slice() {
        [(first, _), (second, at)] => {
            if first == second {
                return Err(Fault::new(*at, format!("the same is stated twice of {name}"))
                    .mend("state a second locus, from another point or of another kind"));
            }
            Ok([*first, *second])
        }
        _ => {
            let has = if found.is_empty() { "none is" } else { "one is" };
            let what = format!("{name} needs two loci to stand, and {has} given");
            Err(Fault::new(value.at, what).mend(FORMS))
        }
    }
}

/// One locus; a ray with a distance is two.
fn read_locus(value: &Value<'_>, of: PointId, draft: &Draft<'_>) -> Res<Vec<Locus>> {
    let fields = Fields::of(value, keys::LOCUS, "a locus, such as {\"from\": \"O3\", \"distance\": 12.5}")?;
    let only = |own: &[&str]| {
        let others: Vec<&str> = keys::LOCUS.iter().copied().filter(|key| !own.contains(key)).collect();
        fields.refuse(&others, FORMS)
    };
    let point = |value: &Value<'_>| -> Res<PointId> {
        let point = draft.point(value)?;
        if point == of {
            let what = format!("{} cannot be stated from itself", draft.say_point(of));
            return Err(Fault::new(value.at, what).mend(
                "name points that stand already; a right angle at the point itself is {\"sees\": [\"P\", \"Q\"], \"at\": 90}",
            ));
        }
        Ok(point)
    };
    let two = |value: &Value<'_>| -> Res<[PointId; 2]> {
        match value.list("two points, such as [\"O2\", \"A\"]")? {
            [first, second] => {
                let ends = [point(first)?, point(second)?];
                if ends[0] == ends[1] {
                    return Err(Fault::new(second.at, "the two points are one"));
                }
                Ok(ends)
            }
            other => Err(Fault::new(value.at, format!("expected two points, found {} entries", other.len()))),
        }
    };
    if let Some(from) = fields.get("from") {
        let from_point = point(from)?;
        if let Some(to) = fields.get("square_to") {
            only(&["from", "square_to"])?;
            return Ok(vec![Locus::Square { through: from_point, to: two(to)? }]);
        }
        only(&["from", "distance", "direction"])?;
        let distance =
            fields.get("distance").map(|d| draft.scales.positive(d, "the distance")).transpose()?;
        let direction = fields.get("direction").map(|d| draft.scales.given(d, Measure::Angle)).transpose()?;
        let circle = distance.map(|radius| Locus::Circle { centre: from_point, radius });
        let ray = direction.map(|direction| Locus::Ray { from: from_point, direction });
        let found: Vec<Locus> = circle.into_iter().chain(ray).collect();
        if found.is_empty() {
            let what = "`from` alone is no locus: `distance`, `direction` or `square_to` is missing";
            return Err(Fault::new(value.at, what).mend(FORMS));
        }
        return Ok(found);
    }
    if let Some(ends) = fields.get("sees") {
        only(&["sees", "at"])?;
        let angle_value = fields.need("at", "the angle at which the segment is seen, such as 90")?;
        let angle = draft.scales.given(angle_value, Measure::Angle)?;
        if angle.value == 0.0 || angle.value.abs() == std::f64::consts::PI {
            let what = "a segment is seen at 0 or 180 degrees from its own line, which is no circle";
            return Err(Fault::new(angle_value.at, what).mend("write that line as {\"on\": guide}"));
        }
        return Ok(vec![Locus::Sees { ends: two(ends)?, angle }]);
    }
    if let Some(on) = fields.get("on") {
        only(&["on"])?;
        return Ok(vec![Locus::On(path_in_world(on, draft)?)]);
    }
    Err(Fault::new(value.at, "this is no locus").mend(FORMS))
}

/// A line or an arc that stands before any link does: of the frame, of a link whose own coordinates are the world's, or
/// by points that stand, of whichever link.
fn path_in_world(on: &Value<'_>, draft: &Draft<'_>) -> Res<Path> {
    let guide = path(on, draft)?;
    if in_world(&guide, draft) {
        return Ok(guide.path);
    }
    let link = draft.say(guide.link);
    let what = format!("own coordinates and angles of {link} do not stand yet: it has dimensions of its own");
    Err(Fault::new(on.at, what).mend(
        "name the guide by points that stand: `through` one `toward` another, or an arc about a `centre`",
    ))
}

/// Whether a guide says the same in the world as in the figure of its link.
fn in_world(guide: &Guide, draft: &Draft<'_>) -> bool {
    if guide.link == LinkId::FRAME || draft.link(guide.link).form == Form::Placed {
        return true;
    }
    let named = |point: GuidePoint| matches!(point, GuidePoint::Point(_));
    match guide.path {
        Path::Straight { through, direction, .. } => {
            named(through) && matches!(direction, Direction::Toward(_))
        }
        Path::Arc { centre, .. } => named(centre),
    }
}

/// The statements, each after those from which it is stated; driven links that others are stated from come in between.
fn in_order(mut open: Vec<Stated>, draft: &Draft<'_>) -> Res<Vec<Stated>> {
    let mut stands: Vec<bool> = draft.mechanism.points.iter().map(|p| p.place.exact().is_some()).collect();
    let mut ordered = Vec::with_capacity(open.len());
    while !open.is_empty() {
        let ready = open.iter().position(|stated| hangs_on(stated).all(|p| stands[p.0]));
        let next = match ready {
            Some(index) => open.remove(index),
            None => {
                // What a driven link leads stands as well.
                let wanted = open.iter().flat_map(hangs_on);
                let wanted = wanted.filter(|p| !stands[p.0] && !open.iter().any(|other| other.point == *p));
                let wanted: Vec<PointId> = wanted.collect();
                let led = wanted.iter().find_map(|&p| driven(p, &stands, draft));
                led.ok_or_else(|| unordered(&open, &wanted, draft))?
            }
        };
        stands[next.point.0] = true;
        ordered.push(next);
    }
    Ok(ordered)
}

fn hangs_on(stated: &Stated) -> impl Iterator<Item = PointId> {
    stated.loci.iter().flat_map(Locus::hangs_on)
}

/// A point that its link leads to where the input says: the far end of a link of given length and angle, whose base
/// stands.
fn driven(point: PointId, stands: &[bool], draft: &Draft<'_>) -> Option<Stated> {
    draft.mechanism.point(point).links.iter().find_map(|&link| {
        let direction = draft.input_angle(link)?;
        let (&base, index) = (draft.link(link).points.first()?, super::links::index_of(draft, link, point)?);
        let radius = match &draft.link(link).form {
            Form::Length(length) if index == 1 => *length,
            Form::Line(positions) if positions[0].value == 0.0 && positions[index].value > 0.0 => {
                positions[index]
            }
            _ => return None,
        };
        let loci = [Locus::Circle { centre: base, radius }, Locus::Ray { from: base, direction }];
        stands[base.0].then_some(Stated { at: draft.anchors.place(point), point, loci, driven: true })
    })
}

/// Why no point of these can be drawn next.
fn unordered(open: &[Stated], wanted: &[PointId], draft: &Draft<'_>) -> Fault {
    if let Some(&wanted) = wanted.first() {
        let by = open.iter().find(|stated| hangs_on(stated).any(|p| p == wanted));
        let (at, of) = by.map_or((0, wanted), |stated| (stated.at, stated.point));
        let (missing, of) = (draft.say_point(wanted), draft.say_point(of));
        let what = format!("{of} is stated from {missing}, which does not stand: it has no place of its own");
        let mend = format!("fix {missing}, or give its place in `placed` or by two loci in `where`");
        return Fault::new(at, what).mend(mend);
    }
    // Every point depends on another one: follow them until one comes again.
    let mut way: Vec<&Stated> = Vec::new();
    let mut here = open.first();
    while let Some(stated) = here {
        if let Some(start) = way.iter().position(|other| other.point == stated.point) {
            way.drain(..start);
            break;
        }
        way.push(stated);
        here = open.iter().find(|other| hangs_on(stated).any(|p| p == other.point));
    }
    let name = |stated: &Stated| draft.say_point(stated.point);
    let turn = way.iter().zip(way.iter().cycle().skip(1));
    let steps: Vec<String> = turn.map(|(a, b)| format!("{} from {}", name(a), name(b))).collect();
    let what = format!("these points are stated in a circle: {}", steps.join(", "));
    Fault::new(way.first().map_or(0, |stated| stated.at), what)
        .mend("state one of them from points that stand without the others")
}

/// What else holds a stated point.
enum Bond {
    /// A dimension or guide that says where it lies as a locus does.
    Locus(Locus),
    /// One that leaves it one freedom, but whose numbers must be found first.
    Derived,
    /// It holds the point wholly.
    Whole,
}

/// How the statement of a point goes together with what else the scene says of it.
fn standing(point: PointId, loci: &[Locus; 2], draft: &Draft<'_>) -> Standing {
    let known = known(draft);
    let mut bonds: Vec<Bond> = Vec::new();
    for &link in &draft.mechanism.point(point).links {
        bonds.extend(link_bond(point, link, &known, draft));
    }
    bonds.extend(pair_bonds(point, &known, draft));
    let whole = bonds.iter().any(|bond| matches!(bond, Bond::Whole));
    let bound = whole || bonds.len() > 1;
    if bound && !needed(point, draft) {
        return Standing::Hint;
    }
    // What repeats a locus of the statement adds nothing.
    let further: Vec<Locus> = bonds
        .iter()
        .filter_map(|bond| match bond {
            Bond::Locus(locus) if !loci.contains(locus) => Some(*locus),
            _ => None,
        })
        .collect();
    match further.as_slice() {
        [] => Standing::Stated,
        [locus] => Standing::Onto(*locus),
        [first, second, ..] => Standing::AtMeet([*first, *second]),
    }
}

/// Which points stand before one is looked at: given ones, those that were stated before, and what inputs and
/// dimensions make of these.
fn known(draft: &Draft<'_>) -> Vec<bool> {
    let mechanism = &draft.mechanism;
    let mut known: Vec<bool> = mechanism
        .points
        .iter()
        .map(|p| match p.place {
            Place::Fixed(_) | Place::Placed(_) => true,
            Place::Stated(index) => index < mechanism.statements.len(),
            Place::Near(_) | Place::Unknown => false,
        })
        .collect();
    for input in &mechanism.inputs {
        if let Input::Slide { slide, at: Some(_), .. } = input
            && let Some(point) = draft.riding_point(&mechanism.slides[*slide].rider)
            && mechanism.slides[*slide].guide.link == LinkId::FRAME
        {
            known[point.0] = true;
        }
    }
    for _ in 0..DEEPEST {
        let mut grown = false;
        for link in mechanism.moving() {
            let points = &draft.link(link).points;
            if own_figure(link, draft) && is_posed(link, None, &known, draft) {
                for point in points {
                    // A point whose statement is still to come is not known by it.
                    grown |= !std::mem::replace(&mut known[point.0], true);
                }
            }
        }
        if !grown {
            break;
        }
    }
    known
}

/// Whether a point is drawn before the one that is looked at: what dimensions make known is found later.
fn stands_by_now(point: PointId, draft: &Draft<'_>) -> bool {
    let place = &draft.mechanism.point(point).place;
    match place {
        Place::Stated(index) => *index < draft.mechanism.statements.len(),
        Place::Fixed(_) | Place::Placed(_) | Place::Near(_) | Place::Unknown => place.exact().is_some(),
    }
}

/// Whether a link has dimensions of its own and more than one point.
fn own_figure(link: LinkId, draft: &Draft<'_>) -> bool {
    link != LinkId::FRAME && !matches!(draft.link(link).form, Form::Placed | Form::Single)
}

/// Whether the known points of a link, `but` one, say where it lies, with its input or its ride.
fn is_posed(link: LinkId, but: Option<PointId>, known: &[bool], draft: &Draft<'_>) -> bool {
    let points = draft.link(link).points.iter().filter(|p| Some(**p) != but && known[p.0]).count();
    let directed = draft.input_angle(link).is_some()
        || draft.mechanism.slides.iter().any(|slide| match slide.rider {
            Rider::Link { link: rider, turned: Some(_) } => {
                rider == link && slide.guide.link == LinkId::FRAME
            }
            _ => false,
        });
    points > 1 || (points == 1 && directed)
}

/// What a link says of where one of its points lies.
fn link_bond(point: PointId, link: LinkId, known: &[bool], draft: &Draft<'_>) -> Option<Bond> {
    let of = draft.link(link);
    if of.form == Form::Placed && link != LinkId::FRAME {
        // Its input angle is the direction of its first two joints.
        let angle = draft.input_angle(link)?;
        let (other, second) = match of.points.as_slice() {
            [first, second, ..] if *first == point => (*second, false),
            [first, second, ..] if *second == point => (*first, true),
            _ => return None,
        };
        let line = Path::Straight {
            through: GuidePoint::Point(other),
            direction: Direction::Angle(angle),
            turned: Given::exact(0.0),
            offset: Given::exact(0.0),
        };
        let locus = if second { Locus::Ray { from: other, direction: angle } } else { Locus::On(line) };
        let bond = if stands_by_now(other, draft) { Bond::Locus(locus) } else { Bond::Derived };
        return known[other.0].then_some(bond);
    }
    if !own_figure(link, draft) {
        return None;
    }
    if is_posed(link, Some(point), known, draft) {
        return Some(Bond::Whole);
    }
    let &other = of.points.iter().find(|p| **p != point && known[p.0])?;
    Some(match of.form {
        // A circle can be drawn before the skeleton only about what is given, or stated before, not about what an input or
        // dimensions lead to.
        Form::Length(radius) if of.extra.is_empty() && stands_by_now(other, draft) => {
            Bond::Locus(Locus::Circle { centre: other, radius })
        }
        _ => Bond::Derived,
    })
}

/// What the sliding and rolling pairs say of where a point lies.
fn pair_bonds(point: PointId, known: &[bool], draft: &Draft<'_>) -> Vec<Bond> {
    let mechanism = &draft.mechanism;
    let mut bonds = Vec::new();
    for (index, slide) in mechanism.slides.iter().enumerate() {
        if draft.riding_point(&slide.rider) != Some(point) {
            continue;
        }
        let at = mechanism
            .inputs
            .iter()
            .any(|input| matches!(input, Input::Slide { slide, at: Some(_), .. } if *slide == index));
        let locus = Locus::On(slide.guide.path);
        // As a circle, it can be drawn before the skeleton only by what is given, or stated before.
        let drawn =
            in_world(&slide.guide, draft) && locus.hangs_on().iter().all(|p| stands_by_now(*p, draft));
        let posed =
            slide.guide.link == LinkId::FRAME || is_posed(slide.guide.link, None, known, draft) || drawn;
        match (posed, at) {
            (true, true) => bonds.push(Bond::Whole),
            (true, false) if drawn => bonds.push(Bond::Locus(locus)),
            (true, false) => bonds.push(Bond::Derived),
            (false, _) => {}
        }
    }
    for roll in &mechanism.rolls {
        match roll {
            Roll::Circles { centres, .. } if centres.contains(&point) => {
                let other = if centres[0] == point { centres[1] } else { centres[0] };
                let links = &mechanism.point(point).links;
                let held = links.iter().any(|link| draft.stands_in(other, *link));
                if known[other.0] && !held {
                    bonds.push(Bond::Derived);
                }
            }
            Roll::Line { guide, centre, .. } if *centre == point && guide.link == LinkId::FRAME => {
                let rides = mechanism.slides.iter().any(|slide| {
                    slide.guide.link == guide.link && draft.riding_point(&slide.rider) == Some(point)
                });
                if !rides {
                    bonds.push(Bond::Derived);
                }
            }
            Roll::Circles { .. } | Roll::Line { .. } => {}
        }
    }
    bonds
}

/// Whether the place of a point is needed whatever holds it: by a link that has no other dimensions, or by an input
/// that does not say where it stands.
fn needed(point: PointId, draft: &Draft<'_>) -> bool {
    let links = &draft.mechanism.point(point).links;
    let of_link = links.iter().any(|l| *l != LinkId::FRAME && draft.link(*l).form == Form::Placed);
    let of_input = draft.mechanism.inputs.iter().any(|input| match input {
        Input::Angle { link, angle: None, .. } | Input::Speed { link, angle: None, .. } => {
            links.contains(link)
        }
        Input::Slide { slide, at: None, .. } => {
            draft.riding_point(&draft.mechanism.slides[*slide].rider) == Some(point)
        }
        _ => false,
    });
    of_link || of_input
}
