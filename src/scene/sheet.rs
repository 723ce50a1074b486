//! How the sheet is to be drawn, and its title.

use super::asked::named;
use super::diagnostic::{Fault, Res};
use super::json::{Entry, Fields, Kind, Value};
use super::units::{Measure, Scale, Scales, Words, drawing_scale, number};
use super::{AngularAcceleration, LiveOptions, Scene, SheetOptions, Title, keys};
use crate::limits::POSITIONS;
use crate::mechanism::{Input, Mechanism, Sense};

/// Languages of the sheet.
pub(super) const LANGUAGES: [&str; 4] = ["en", "ar", "ar-x-ajala", "fa"];
/// Paper sizes; `portrait` or `landscape` may stand after them.
pub(super) const PAPERS: [&str; 9] = ["A0", "A1", "A2", "A3", "A4", "A5", "A6", "letter", "legal"];

/// No answer has more marks.
const MOST_MARKS: f64 = 1000.0;

/// Colours of the sheet.
pub(super) const THEMES: [&str; 3] = ["mono", "colour", "dark"];
/// Notations of vectors.
pub(super) const NOTATIONS: [&str; 5] = ["standard", "norton", "uicker", "rattan", "martin"];

/// Scales of a live page: one for the course, or one for each position.
pub(super) const LIVE_SCALES: [&str; 2] = ["fixed", "refit"];

/// What a panel of the live page can show, by the names of the figures.
pub(super) const LIVE_PANELS: [&str; 11] = [
    "skeleton",
    "velocity",
    "acceleration",
    "centres",
    "circle",
    "transfer",
    "klein",
    "inflection",
    "centrodes",
    "kennedy",
    "rotation-centre",
];
/// The course plays no faster and no slower, s.
pub(super) const PLAY_SECONDS: [f64; 2] = [1.0, 120.0];

/// Reads `title`.
pub(super) fn title(value: Option<&Value<'_>>) -> Res<Title> {
    let Some(value) = value else { return Ok(Title::default()) };
    match &value.kind {
        Kind::Text(text) => Ok(Title { plain: Some(text.clone()), by_language: Vec::new() }),
        Kind::Object(entries) => {
            let mut title = Title::default();
            for Entry { at, key, value } in entries {
                let part =
                    |p: &str| !p.is_empty() && p.len() <= 8 && p.bytes().all(|b| b.is_ascii_alphanumeric());
                if !key.split('-').all(part) {
                    return Err(Fault::new(*at, format!("`{}` is not a language tag", key.escape_debug()))
                        .known(key, LANGUAGES));
                }
                title.by_language.push((key.clone(), value.text("a title, as text")?.to_owned()));
            }
            Ok(title)
        }
        _ => Err(value.unexpected("text, or texts by language")),
    }
}

/// What the first input measures.
fn input_measure(mechanism: &Mechanism) -> Measure {
    match mechanism.inputs.first() {
        Some(Input::Slide { .. }) => Measure::Length,
        _ => Measure::Angle,
    }
}

/// Reads `sheet`.
pub(super) fn read(value: Option<&Value<'_>>, scales: &Scales, mechanism: &Mechanism) -> Res<SheetOptions> {
    let input = input_measure(mechanism);
    let mut sheet = SheetOptions::default();
    let Some(value) = value else { return Ok(sheet) };
    let fields = Fields::of(value, keys::SHEET, "how to draw the sheet")?;
    sheet.paper = fields.get("paper").map(paper).transpose()?;
    sheet.language = fields.get("language").map(|v| one_of(v, &LANGUAGES, "a language")).transpose()?;
    sheet.theme = fields.get("theme").map(|v| one_of(v, &THEMES, "a theme")).transpose()?;
    if let Some(symbols) = fields.get("symbols") {
        let name = one_of(symbols, &["alpha", "epsilon"], "a letter for angular acceleration")?;
        let epsilon = name == "epsilon";
        sheet.angular_acceleration =
            Some(if epsilon { AngularAcceleration::Epsilon } else { AngularAcceleration::Alpha });
    }
    sheet.notation = fields.get("notation").map(|v| one_of(v, &NOTATIONS, "a notation")).transpose()?;
    if let Some(decimal) = fields.get("decimal") {
        sheet.decimal_comma = one_of(decimal, &["point", "comma"], "a decimal sign")? == "comma";
    }
    let nested =
        fields.get("scales").map(|v| Fields::of(v, keys::SCALES, "scales by diagram")).transpose()?;
    let scale = |key: &str, measure: Measure| -> Res<Option<f64>> {
        let inner = nested.as_ref().and_then(|f| f.entry(key));
        // The scales of motion may stand in `sheet` itself.
        let own = keys::SHEET.contains(&key).then(|| fields.entry(key)).flatten();
        let chosen = match (inner, own) {
            (Some(one), Some(other)) => {
                return Err(Fault::new(one.at.max(other.at), format!("the `{key}` scale is given twice")));
            }
            (one, other) => one.or(other),
        };
        chosen.map(|entry| drawing_scale(&entry.value, measure, scales)).transpose()
    };
    sheet.length_scale = scale("length", Measure::Length)?;
    // From metres of paper to millimetres.
    sheet.velocity_scale = scale("velocity", Measure::Velocity)?.map(|s| s / 1000.0);
    sheet.acceleration_scale = scale("acceleration", Measure::Acceleration)?.map(|s| s / 1000.0);
    sheet.force_scale = scale("force", Measure::Force)?.map(|s| s / 1000.0);
    if let Some(marks) = fields.get("marks") {
        for Entry { at, key, value } in marks.object("marks, by name of the quantity")? {
            // Points of a figure, `velocity:b`, are named as the student's drawing names them.
            if !key.contains(':') {
                named(key, *at, mechanism, scales)?;
            }
            let Kind::Number(digits) = value.kind else { return Err(value.unexpected("a number of marks")) };
            let weight = number(digits, value.at)?.value;
            if !(0.0..=MOST_MARKS).contains(&weight) {
                return Err(Fault::new(value.at, format!("choose between 0 and {MOST_MARKS} marks")));
            }
            sheet.marks.push((key.clone(), weight));
        }
    }
    if let Some(figures) = fields.get("figures") {
        for item in figures.list("a list of figures, such as [\"skeleton\", \"velocity\"]")? {
            sheet.figures.push(item.text("the name of a figure")?.to_owned());
        }
    }
    if let Some(positions) = fields.get("positions") {
        let all = positions.list("a list of places of the input, such as [60, \"90 deg\"]")?;
        if all.len() > POSITIONS {
            let what = format!("{} positions cannot be told apart", all.len());
            return Err(Fault::new(positions.at, what).mend(format!("list {POSITIONS} at most")));
        }
        for item in all {
            let stated = scales.stated(item, input, input.turns(), scales.bare(input))?;
            let words = match &item.kind {
                Kind::Number(digits) => Some(Words { digits, unit: "", sense: None }),
                Kind::Text(text) => Words::split(text),
                _ => None,
            };
            let place = words.and_then(|words| whole_turns(&words, &stated.scale));
            sheet.positions.push(place.unwrap_or(stated.given.value));
        }
    }
    if let Some(other) = fields.get("other_assembly") {
        sheet.other_assembly = other.bool()?;
    }
    if let Some(value) = fields.get("live") {
        sheet.live = live(value, scales, mechanism)?;
    }
    Ok(sheet)
}

/// Reads `live`.
fn live(value: &Value<'_>, scales: &Scales, mechanism: &Mechanism) -> Res<LiveOptions> {
    let fields = Fields::of(value, keys::LIVE, "how the live page opens")?;
    let mut live = LiveOptions::default();
    if let Some(value) = fields.get("play_seconds") {
        let Kind::Number(digits) = value.kind else { return Err(value.unexpected("a number of seconds")) };
        let [least, most] = PLAY_SECONDS;
        let seconds = number(digits, value.at)?.value;
        if !(least..=most).contains(&seconds) {
            return Err(Fault::new(value.at, format!("choose between {least} and {most} seconds")));
        }
        live.play_seconds = Some(seconds);
    }
    if let Some(traces) = fields.get("traces") {
        for item in traces.list("a list of points, such as [\"B\"]")? {
            let name = item.text("the name of a point")?;
            let point = mechanism.point_named(name).ok_or_else(|| {
                let known = mechanism.points.iter().map(|point| point.name.as_str());
                Fault::new(item.at, format!("there is no point `{}`", name.escape_debug())).known(name, known)
            })?;
            live.traces.push(point);
        }
    }
    if let Some(diagrams) = fields.get("diagrams") {
        for item in diagrams.list("a list of quantities, such as [\"omega(4)\"]")? {
            let name = item.text("the name of a quantity")?;
            let wanted = named(name, item.at, mechanism, scales)?.quantity;
            let row = mechanism.asked.iter().position(|asked| asked.quantity == wanted).ok_or_else(|| {
                Fault::new(item.at, format!("a diagram shows what is asked for, and `{name}` is not"))
                    .mend(format!("add \"{name}\" to `find`"))
            })?;
            live.diagrams.push(row);
        }
    }
    if let Some(scale) = fields.get("scale") {
        live.refit = Some(one_of(scale, &LIVE_SCALES, "a way to choose scales")? == "refit");
    }
    if let Some(panels) = fields.get("panels") {
        for item in panels.list("a list of panels, such as [\"skeleton\", \"velocity\"]")? {
            let name = one_of(item, &LIVE_PANELS, "a panel of the page")?;
            live.panels.extend(LIVE_PANELS.into_iter().find(|known| *known == name));
        }
    }
    Ok(live)
}

/// The place of the first input that `text` states, in the scene's unit where it names none: rad, or m for a slide.
///
/// # Errors
/// One clause that says what is wrong with it.
pub fn input_place(text: &str, scene: &Scene) -> Result<f64, String> {
    let measure = input_measure(&scene.mechanism);
    let unit = if measure == Measure::Length { &scene.units.length } else { &scene.units.angle };
    let read = || {
        let words = Words::split(text)?;
        let name = if words.unit.is_empty() { unit.symbol.as_str() } else { words.unit };
        let scale = Scale::parse(name, 0).and_then(|scale| scale.must_be(measure, 0)).ok()?;
        whole_turns(&words, &scale).filter(|_| words.sense.is_none() || measure.turns())
    };
    read().ok_or_else(|| format!("`{text}` is not {}", measure.noun()))
}

/// A place in SI units with all its turns: an angle that is only a direction has them taken off.
fn whole_turns(words: &Words<'_>, scale: &Scale) -> Option<f64> {
    let place = number(words.digits, 0).ok()?.value * scale.si();
    let turned = if words.sense == Some(Sense::Cw) { -place } else { place };
    // A negative zero would print as one.
    turned.is_finite().then_some(turned + 0.0)
}

fn one_of(value: &Value<'_>, known: &[&str], what: &str) -> Res<String> {
    let name = value.text(&format!("the name of {what}"))?;
    if known.contains(&name) {
        return Ok(name.to_owned());
    }
    Err(Fault::new(value.at, format!("`{name}` is not {what}")).known(name, known.iter().copied()))
}

fn paper(value: &Value<'_>) -> Res<String> {
    let text = value.text("a paper size, such as \"A4\"")?;
    paper_size(text).ok_or_else(|| {
        let size = text.split_whitespace().next().unwrap_or_default();
        let fault = Fault::new(value.at, format!("`{text}` is not a paper size"));
        match PAPERS.iter().find(|name| name.eq_ignore_ascii_case(size)) {
            None => fault.known(size, PAPERS),
            Some(name) => fault.mend(format!("write `{name}`, `{name} portrait` or `{name} landscape`")),
        }
    })
}

/// A paper size as a scene states it (`a4`, `A3 landscape`), in one spelling; `None` where it is none.
#[must_use]
pub fn paper_size(text: &str) -> Option<String> {
    let mut words = text.split_whitespace();
    let size = words.next()?;
    let name = PAPERS.iter().find(|name| name.eq_ignore_ascii_case(size))?;
    match (words.next(), words.next()) {
        (None, _) => Some((*name).to_owned()),
        (Some(way @ ("portrait" | "landscape")), None) => Some(format!("{name} {way}")),
        _ => None,
    }
}
