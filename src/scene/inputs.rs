//! What drives the mechanism.

use super::InputUnits;
use super::diagnostic::{Fault, Res};
use super::draft::{Draft, is_straight};
use super::json::{Fields, Kind, Value};
use super::keys;
use super::links::own_coordinates;
use super::units::{Measure, Scales};
use crate::mechanism::quantity::Unit;
use crate::mechanism::{Given, Input, LinkId, Place, PointId, Rider};

/// Reads `input` or `inputs`.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let items = match (scene.entry("input"), scene.entry("inputs")) {
        (Some(one), Some(other)) => {
            let fault = Fault::new(one.at.max(other.at), "`input` and `inputs` are given both");
            return Err(fault.mend("list all of them in `inputs`"));
        }
        (Some(one), None) => {
            if matches!(one.value.kind, Kind::List(_)) {
                return Err(Fault::new(one.at, "`input` is one input").mend("list several in `inputs`"));
            }
            std::slice::from_ref(&one.value)
        }
        (None, Some(list)) => list.value.list("a list of inputs")?,
        (None, None) => &[],
    };
    draft.anchors.all_inputs = scene.get("input").or_else(|| scene.get("inputs")).map(|value| value.at);
    for item in items {
        let fields = Fields::of(item, keys::INPUT, "an input: {\"link\": 2, \"angle\": …, \"omega\": …}")?;
        let input = match (fields.get("link"), fields.entry("slide")) {
            (Some(link), None) => link_input(&fields, link, draft)?,
            (None, Some(slide)) => slide_input(&fields, &slide.value, draft)?,
            (Some(_), Some(slide)) => {
                return Err(Fault::new(slide.at, "an input drives a `link` or a `slide`, not both")
                    .mend("list two inputs in `inputs`"));
            }
            (None, None) => {
                return Err(Fault::new(item.at, "what is driven is missing")
                    .mend("name a `link` by its number, or a `slide` by its pin"));
            }
        };
        if draft.mechanism.inputs.iter().any(|other| same_drive(other, &input)) {
            return Err(Fault::new(item.at, "this is driven by another input already"));
        }
        draft.mechanism.inputs.push(input);
        draft.input_units.push(units(&fields, draft)?);
        draft.anchors.inputs.push(item.at);
    }
    Ok(())
}

fn same_drive(one: &Input, other: &Input) -> bool {
    let driven = |input: &Input| match input {
        Input::Angle { link, .. } | Input::Speed { link, .. } => (Some(*link), None),
        Input::Slide { slide, .. } => (None, Some(*slide)),
    };
    driven(one) == driven(other)
}

/// An angle with the whole turns that were taken off when it was read.
pub(super) fn unreduced(value: &Value<'_>, scales: &Scales) -> Res<f64> {
    let stated = scales.stated(value, Measure::Angle, true, scales.bare(Measure::Angle))?;
    let number: Option<f64> = match &value.kind {
        Kind::Number(digits) => digits.parse().ok(),
        Kind::Text(text) => text.split_whitespace().next().and_then(|n| n.parse().ok()),
        _ => None,
    };
    let Some(size) = number.map(|n| n.abs() * stated.scale.si()) else { return Ok(stated.given.value) };
    let miss = |angle: &f64| (angle.abs() - size).abs();
    let turn = std::f64::consts::TAU;
    // Half a turn stays as it is: −180° is as near to 180 as 180° itself.
    let whole = [size, -size].map(|own| libm::round((own - stated.given.value) / turn) * turn);
    let turned = [0.0].into_iter().chain(whole).map(|turns| stated.given.value + turns);
    let nearest = turned.reduce(|a, b| if miss(&b) < miss(&a) { b } else { a });
    Ok(nearest.unwrap_or(stated.given.value))
}

/// How an input's motion is stated.
fn units(fields: &Fields<'_, '_>, draft: &Draft<'_>) -> Res<InputUnits> {
    let unit = |value: &Value<'_>, measure: Measure| -> Res<Unit> {
        Ok(draft.scales.stated(value, measure, true, draft.scales.bare(measure))?.scale.unit())
    };
    let of = |key: &str, measure| fields.get(key).map(|value| unit(value, measure)).transpose();
    let speed = match fields.get("speed").map(|value| &value.kind) {
        Some(Kind::Object(entries)) => entries.first(),
        _ => None,
    };
    let speed = speed.map(|entry| unit(&entry.value, Measure::Velocity)).transpose()?;
    Ok(InputUnits {
        angle: fields.get("angle").map(|angle| unreduced(angle, draft.scales)).transpose()?,
        rate: of("omega", Measure::AngularVelocity)?.or(of("velocity", Measure::Velocity)?).or(speed),
        second: of("alpha", Measure::AngularAcceleration)?.or(of("acceleration", Measure::Acceleration)?),
    })
}

/// A number that is zero where it is left out.
fn rate(fields: &Fields<'_, '_>, key: &str, measure: Measure, draft: &Draft<'_>) -> Res<Given> {
    fields.get(key).map_or(Ok(Given::exact(0.0)), |value| draft.scales.given(value, measure))
}

fn link_input(fields: &Fields<'_, '_>, value: &Value<'_>, draft: &Draft<'_>) -> Res<Input> {
    fields.refuse(&["at", "velocity", "acceleration"], "it belongs to a driven `slide`")?;
    let link = draft.moving_link(value)?;
    let angle = fields.get("angle").map(|angle| match draft.loads_count_turns {
        true => draft.scales.whole_angle(angle),
        false => draft.scales.given(angle, Measure::Angle),
    });
    let angle = angle.transpose()?;
    let points = &draft.link(link).points;
    if draft.link(link).joints().len() > 1 {
        let own = |index| own_coordinates(draft.link(link), index).map(|(place, _)| place);
        let exact = |index: usize| points.get(index).and_then(|p| draft.mechanism.point(*p).place.exact());
        let same = match (own(0), own(1), exact(0), exact(1)) {
            (Some(one), Some(other), ..) => one == other,
            (None, None, Some(one), Some(other)) => one.map(|c| c.value) == other.map(|c| c.value),
            _ => false,
        };
        if same {
            let what =
                format!("the first two joints of {} lie in one place and give no angle", draft.say(link));
            return Err(Fault::new(value.at, what).mend("change the order of `joins`"));
        }
        if angle.is_none() && points.iter().filter(|p| draft.is_exact(**p)).count() < 2 {
            let what = format!("`angle` is missing: {} is not placed", draft.say(link));
            let free: Vec<&str> =
                points.iter().take(2).filter(|p| !draft.is_exact(**p)).map(|p| draft.say_point(*p)).collect();
            return Err(Fault::new(fields.at, what).mend(format!(
                "give the angle of the line from {} to {}, or the place of {} in `placed` or `where`",
                draft.say_point(points[0]),
                draft.say_point(points[1]),
                free.join(" and ")
            )));
        }
    }
    let alpha = rate(fields, "alpha", Measure::AngularAcceleration, draft)?;
    let Some(speed) = fields.get("speed") else {
        let omega = rate(fields, "omega", Measure::AngularVelocity, draft)?;
        return Ok(Input::Angle { link, angle, omega, alpha });
    };
    fields.refuse(&["omega"], "the `speed` of a point gives it")?;
    let (point, speed) = point_speed(speed, link, draft)?;
    Ok(Input::Speed { link, angle, point, speed, alpha })
}

/// `{"A": "6 m/s ccw"}`.
fn point_speed(value: &Value<'_>, link: LinkId, draft: &Draft<'_>) -> Res<(PointId, Given)> {
    let expected = "the speed of one point, such as {\"A\": \"6 m/s ccw\"}";
    let [entry] = value.object(expected)? else {
        return Err(Fault::new(value.at, format!("expected {expected}")));
    };
    let point = draft.point_named(&entry.key, entry.at)?;
    let points = &draft.link(link).points;
    let Some(index) = points.iter().position(|p| *p == point) else {
        let what = format!("{} does not stand in {}", entry.key, draft.say(link));
        let names: Vec<&str> = points.iter().skip(1).map(|p| draft.say_point(*p)).collect();
        return Err(Fault::new(entry.at, what).known(&entry.key, names));
    };
    let own = |index| own_coordinates(draft.link(link), index).map(|(place, _)| place);
    if index == 0 || own(index).is_some_and(|place| Some(place) == own(0)) {
        let what = format!("{} is where {} turns and has no speed about it", entry.key, draft.say(link));
        return Err(Fault::new(entry.at, what).mend("name another point of the link"));
    }
    let scale = draft.scales.bare(Measure::Velocity);
    let speed = draft.scales.stated(&entry.value, Measure::Velocity, true, scale)?;
    Ok((point, speed.given))
}

fn slide_input(fields: &Fields<'_, '_>, value: &Value<'_>, draft: &Draft<'_>) -> Res<Input> {
    fields.refuse(&["angle", "omega", "alpha", "speed"], "it belongs to a driven `link`")?;
    let slide = named_slide(value, draft)?;
    let pair = &draft.mechanism.slides[slide];
    if !is_straight(&pair.guide) {
        return Err(Fault::new(value.at, "a slide on an arc cannot be driven")
            .mend("drive a link that is pinned at the arc's centre"));
    }
    let rider = draft.riding_point(&pair.rider);
    let at = fields.get("at").map(|at| draft.scales.given(at, Measure::Length)).transpose()?;
    if let (None, Some(point)) = (at, rider.filter(|p| !draft.is_exact(*p))) {
        let name = draft.say_point(point);
        return Err(Fault::new(fields.at, format!("`at` is missing: {name} is not placed")).mend(format!(
            "give its distance along the guide from `through`, or the place of {name} in `placed` or `where`"
        )));
    }
    let of_frame = rider.is_some_and(|p| matches!(draft.mechanism.point(p).place, Place::Fixed(_)));
    let moving = (0..draft.mechanism.points.len()).map(PointId);
    let mut moving = moving.filter(|p| !matches!(draft.mechanism.point(*p).place, Place::Fixed(_)));
    if let (None, true, false) = (at, of_frame, moving.any(|p| draft.is_exact(p))) {
        let (rider, guide) = (rider.map_or("", |p| draft.say_point(p)), draft.say(pair.guide.link));
        let what = format!("`at` is missing: {rider} is fixed, and nothing says where {guide} stands");
        return Err(Fault::new(fields.at, what)
            .mend("give its distance along the guide from `through`, or places of moving points in `placed` or `where`"));
    }
    Ok(Input::Slide {
        slide,
        at,
        velocity: rate(fields, "velocity", Measure::Velocity, draft)?,
        acceleration: rate(fields, "acceleration", Measure::Acceleration, draft)?,
    })
}

/// The sliding pair that a pin's name, or a block's or link's number, means.
fn named_slide(value: &Value<'_>, draft: &Draft<'_>) -> Res<usize> {
    let slides = &draft.mechanism.slides;
    let found: Vec<usize> = match value.kind {
        Kind::Number(_) => {
            let link = draft.link_at(value)?;
            let rides = |rider: &Rider| match rider {
                Rider::Pin { block, .. } => *block == Some(link),
                Rider::Link { link: rider, .. } => *rider == link,
            };
            (0..slides.len()).filter(|i| rides(&slides[*i].rider)).collect()
        }
        Kind::Text(_) => {
            let text = value.text("the pin that slides")?;
            if text.parse::<u32>().is_ok() {
                let fault = Fault::new(value.at, format!("\"{text}\" is a text, and no pin is called so"));
                return Err(
                    fault.mend(format!("a block or link is named by its number: {text}, without quotes"))
                );
            }
            let point = draft.point(value)?;
            let rides = |rider: &Rider| match rider {
                Rider::Pin { point: pin, .. } => *pin == point,
                Rider::Link { link, .. } => {
                    draft.wide_blocks.contains(link) && draft.riding_point(rider) == Some(point)
                }
            };
            (0..slides.len()).filter(|i| rides(&slides[*i].rider)).collect()
        }
        _ => return Err(value.unexpected("the pin that slides, or the number of the block or link")),
    };
    match found.as_slice() {
        [slide] => Ok(*slide),
        [] => {
            let named: Vec<String> = slides.iter().map(|slide| say_rider(&slide.rider, draft)).collect();
            let fault = Fault::new(value.at, "nothing in `slides` has this name");
            Err(if named.is_empty() {
                fault
            } else {
                fault.mend(format!("what slides: {}", named.join(", ")))
            })
        }
        [first, ..] => {
            let fault = Fault::new(value.at, "this slides on two guides");
            Err(match slides[*first].rider {
                Rider::Pin { .. } => {
                    fault.mend("name the pair by the number of its block (give each pair a `block` of its own)")
                }
                // A link is no block: its number is the only name of both pairs.
                Rider::Link { .. } => fault.mend(
                    "a link that rides on two guides cannot be driven along one of them: drive a link in its place, \
                     as in {\"link\": 2, \"omega\": 1}",
                ),
            })
        }
    }
}

fn say_rider(rider: &Rider, draft: &Draft<'_>) -> String {
    match rider {
        Rider::Pin { point, block: None } => format!("\"{}\"", draft.say_point(*point)),
        Rider::Pin { point, block: Some(block) } => {
            format!("\"{}\" or {}", draft.say_point(*point), draft.link(*block).number)
        }
        Rider::Link { link, .. } => draft.link(*link).number.to_string(),
    }
}
