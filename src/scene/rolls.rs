//! Rolling pairs and gear meshes.

use super::Gears;
use super::diagnostic::{Fault, Res};
use super::draft::{Draft, is_straight};
use super::guides::guide;
use super::json::{Fields, Value};
use super::keys;
use super::units::Measure;
use crate::double_double::DoubleDouble;
use crate::mechanism::{Given, LinkId, Mechanism, Place, Point, PointId, Roll};

/// More teeth than any wheel has.
const MOST_TEETH: u32 = 1_000_000;

/// Reads `rolls`.
pub(super) fn read(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = value else { return Ok(()) };
    for item in value.list("a list of rolling pairs")? {
        let fields = Fields::of(item, keys::ROLL, "a rolling pair: {\"links\": [2, 3], …}")?;
        let links = fields.need("links", "the numbers of the two bodies, such as [2, 3]")?;
        let [first, second] = pair(links, "the numbers of two links")?;
        let bodies = [draft.link_at(first)?, draft.link_at(second)?];
        if bodies[0] == bodies[1] {
            return Err(Fault::new(second.at, format!("{} cannot roll on itself", draft.say(bodies[1]))));
        }
        let roll = if fields.get("line").is_some() {
            on_line(&fields, bodies, draft)?
        } else {
            circles(&fields, bodies, draft)?
        };
        let gears = gears(&fields, draft)?;
        draft.gears.push(gears);
        draft.mechanism.rolls.push(roll);
        draft.anchors.rolls.push(item.at);
    }
    Ok(())
}

/// The teeth that stand for radii, as the scene states them; none where it states radii.
fn gears(fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<Option<Gears>> {
    let (Some(teeth), Some(stated)) = (fields.get("teeth"), fields.get("module")) else { return Ok(None) };
    let counts = match teeth.list("numbers of teeth") {
        Ok(counts) => counts.iter().map(|count| count.whole("a number of teeth")).collect::<Res<_>>()?,
        Err(_) => vec![teeth.whole("a number of teeth")?],
    };
    Ok(Some(Gears { teeth: counts, module: draft.scales.positive(stated, "the module")?.value }))
}

/// Reads the angles of pressure: as stated, or the usual one of teeth. Called when the scene has forces.
pub(super) fn pressures(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(rolls) = scene.get("rolls") else { return Ok(()) };
    for (index, item) in rolls.list("a list of rolling pairs")?.iter().enumerate() {
        let fields = Fields::of(item, keys::ROLL, "a rolling pair")?;
        let angle = match fields.get("pressure") {
            Some(stated) => {
                let angle = draft.scales.given(stated, Measure::Angle)?;
                if angle.value < 0.0 || angle.value >= std::f64::consts::FRAC_PI_2 {
                    return Err(Fault::new(stated.at, "an angle of pressure lies between 0 and 90 degrees"));
                }
                angle
            }
            None if fields.get("teeth").is_some() => {
                // 20°.
                let angle = DoubleDouble::PI / DoubleDouble::of(9.0);
                Given::fine(angle, angle.hi() * 4.0 * DoubleDouble::ROUNDOFF)
            }
            None => continue,
        };
        if angle.value > 0.0 {
            draft.mechanism.forces.pressures.push((index, angle));
        }
    }
    Ok(())
}

/// Names the contact point of each rolling pair P, or the next letter that no point and no load has, in either case: an image
/// is named by the small one, and with a prime it would be that of an acceleration. It belongs to no link, so nothing can be asked of it
/// by mistake.
pub(super) fn name_contacts(mechanism: &mut Mechanism) {
    for _ in 0..mechanism.rolls.len() {
        let points = mechanism.points.iter().map(|point| &point.name);
        let names: Vec<&String> =
            points.chain(mechanism.forces.loads.iter().map(|load| &load.name)).collect();
        let taken = |own: &str| names.iter().any(|name| name.eq_ignore_ascii_case(own));
        let name = free_letters("P", taken);
        mechanism.contacts.push(PointId(mechanism.points.len()));
        mechanism.points.push(Point { name, place: Place::Unknown, links: Vec::new(), journal: None });
    }
}

/// Letters that are not taken: those that are wanted, or else the first that are free.
pub(super) fn free_letters(wanted: &str, taken: impl Fn(&str) -> bool) -> String {
    /// What no pole, centre of mass, vector or speed is called.
    const LETTERS: [&str; 12] = ["Q", "R", "S", "U", "H", "J", "K", "M", "N", "X", "Y", "Z"];
    let mut tried = std::iter::once(wanted.to_owned())
        .chain((1..).flat_map(|times| LETTERS.iter().map(move |letter| letter.repeat(times))));
    tried.find(|letters| !taken(letters)).unwrap_or_default()
}

fn pair<'v, 'a>(value: &'v Value<'a>, expected: &str) -> Res<[&'v Value<'a>; 2]> {
    match value.list(expected)? {
        [first, second] => Ok([first, second]),
        other => Err(Fault::new(value.at, format!("expected {expected}, found {} entries", other.len()))),
    }
}

fn circles(fields: &Fields<'_, '_>, links: [LinkId; 2], draft: &Draft<'_>) -> Res<Roll> {
    let why = "`line` is missing, without which two circles roll on each other";
    fields.refuse(&["centre", "radius"], &format!("{why}: give `centres` and `radii`"))?;
    let centres = fields.need("centres", "the centres of the two circles, such as [\"O2\", \"A\"]")?;
    let [first, second] = pair(centres, "the names of two centres")?;
    let points: [PointId; 2] = [draft.point_in(first, links[0])?, draft.point_in(second, links[1])?];
    if points[0] == points[1] {
        return Err(Fault::new(second.at, "two circles about one centre cannot roll on each other"));
    }
    let internal = fields.get("internal").map_or(Ok(false), Value::bool)?;
    let (radii, at) = match (fields.get("radii"), fields.entry("teeth")) {
        (Some(radii), None) => {
            fields.refuse(&["module"], "it belongs to `teeth`")?;
            let [first, second] = pair(radii, "two radii")?;
            let radius = |value| draft.scales.positive(value, "a radius");
            ([radius(first)?, radius(second)?], radii.at)
        }
        (None, Some(teeth)) => {
            let [first, second] = pair(&teeth.value, "two numbers of teeth")?;
            let module = module(fields, draft)?;
            ([pitch_radius(first, module)?, pitch_radius(second, module)?], teeth.value.at)
        }
        (Some(_), Some(teeth)) => return Err(Fault::new(teeth.at, "`radii` are given already")),
        (None, None) => {
            return Err(
                Fault::new(fields.at, "`radii` are missing").mend("`teeth` and `module` may stand for them")
            );
        }
    };
    if internal && radii[0].value == radii[1].value {
        return Err(Fault::new(at, "a circle cannot roll inside one of the same radius"));
    }
    Ok(Roll::Circles { links, centres: points, radii, internal })
}

fn on_line(fields: &Fields<'_, '_>, links: [LinkId; 2], draft: &Draft<'_>) -> Res<Roll> {
    fields
        .refuse(&["centres", "radii", "internal"], "a wheel on a `line` has one `centre` and one `radius`")?;
    let value = fields.need("centre", "the wheel's centre")?;
    let centre = draft.point(value)?;
    // Without a number in `line`, the wheel is the body in which the centre stands, the second if both.
    let wheel_is_first = draft.stands_in(centre, links[0]) && !draft.stands_in(centre, links[1]);
    let line = fields.need("line", "the line on which the wheel rolls")?;
    let guide = guide(line, Some(links[usize::from(wheel_is_first)]), draft)?;
    let wheel = match links {
        [first, second] if guide.link == first => second,
        [first, second] if guide.link == second => first,
        _ => {
            let what = format!("the line belongs to {}, which is not in `links`", draft.say(guide.link));
            return Err(Fault::new(line.at, what));
        }
    };
    draft.point_in(value, wheel)?;
    if !is_straight(&guide) {
        return Err(Fault::new(line.at, "a rack or plane is straight")
            .mend("two circles roll by `centres` and `radii`"));
    }
    let radius = match (fields.get("radius"), fields.entry("teeth")) {
        (Some(radius), None) => {
            fields.refuse(&["module"], "it belongs to `teeth`")?;
            draft.scales.positive(radius, "the radius")?
        }
        (None, Some(teeth)) => pitch_radius(&teeth.value, module(fields, draft)?)?,
        (Some(_), Some(teeth)) => return Err(Fault::new(teeth.at, "the `radius` is given already")),
        (None, None) => return Err(Fault::new(fields.at, "the wheel's `radius` is missing")),
    };
    Ok(Roll::Line { guide, wheel, centre, radius })
}

fn module(fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<Given> {
    let module = fields.need("module", "pitch diameter per tooth, such as \"2 mm\"")?;
    draft.scales.positive(module, "the module")
}

/// Half the module for each tooth.
fn pitch_radius(teeth: &Value<'_>, module: Given) -> Res<Given> {
    let count = teeth.whole("a number of teeth")?;
    if count == 0 || count > MOST_TEETH {
        return Err(Fault::new(teeth.at, format!("a wheel cannot have {count} teeth")));
    }
    Ok(module.times(f64::from(count) / 2.0))
}
