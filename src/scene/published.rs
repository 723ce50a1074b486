//! What somebody printed, and which of it is known to be wrong.

use super::asked::{asked, default_scale};
use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::json::{Entry, Fields, Kind, Value};
use super::units::Words;
use super::{Published, Refusal, keys};
use crate::mechanism::quantity::Quantity;

/// Reads `published`.
pub(super) fn read(value: Option<&Value<'_>>, draft: &mut Draft<'_>) -> Res<Vec<Published>> {
    let Some(value) = value else { return Ok(Vec::new()) };
    let mut published = Vec::new();
    for Entry { at, key, value } in value.object("published values, by name of the quantity")? {
        let mut asked = asked(key, *at, None, draft)?;
        let fields = match value.kind {
            Kind::Object(_) => Some(Fields::of(value, keys::PUBLISHED, "a published value")?),
            _ => None,
        };
        let number = match &fields {
            Some(fields) => fields.need("value", "what was printed")?,
            None => value,
        };
        let measure = asked.quantity.measure();
        let default = default_scale(&asked.quantity, draft.scales);
        let mut stated = draft.scales.stated(number, measure, measure.turns(), &default)?;
        if matches!(asked.quantity, Quantity::Cycle(of) if of.is_angle()) {
            // An angle of a cycle keeps its turns.
            stated.given = draft.scales.whole_angle(number)?;
        }
        asked.unit = stated.scale.unit();
        let optional = |key: &str| fields.as_ref().and_then(|f| f.get(key));
        published.push(Published {
            asked,
            value: stated.given.value,
            signed: stated.sense.is_some(),
            within: optional("within").map(within).transpose()?,
            why: optional("why").map(|why| Ok(why.text("text")?.to_owned())).transpose()?,
        });
        draft.anchors.published.push(*at);
    }
    Ok(published)
}

/// `"10 %"`, or a fraction.
fn within(value: &Value<'_>) -> Res<f64> {
    let wrong = || Fault::new(value.at, "expected a relative deviation").mend("write it as \"10 %\"");
    let (digits, parts) = match &value.kind {
        Kind::Number(digits) => (*digits, 1.0),
        Kind::Text(text) => match Words::split(text) {
            Some(Words { digits, unit: "%", sense: None }) => (digits, 100.0),
            Some(Words { digits, unit: "", sense: None }) => (digits, 1.0),
            _ => return Err(wrong()),
        },
        _ => return Err(wrong()),
    };
    let fraction = super::units::number(digits, value.at)?.value / parts;
    if fraction > 0.0 && fraction <= 1.0 {
        return Ok(fraction);
    }
    Err(Fault::new(value.at, "a deviation is more than 0 % and at most 100 %").mend("write it as \"10 %\""))
}

/// Reads `errata`: names in `published`.
pub(super) fn errata(value: Option<&Value<'_>>, published: &[Published]) -> Res<Vec<String>> {
    let Some(value) = value else { return Ok(Vec::new()) };
    let mut errata: Vec<String> = Vec::new();
    for item in value.list("a list of names that stand in `published`")? {
        let name = item.text("a name that stands in `published`")?;
        if !published.iter().any(|p| p.asked.name == name) {
            let known = published.iter().map(|p| p.asked.name.as_str());
            return Err(Fault::new(item.at, format!("`{name}` is not in `published`")).known(name, known));
        }
        if errata.iter().any(|other| other == name) {
            return Err(Fault::new(item.at, format!("`{name}` is listed twice")));
        }
        errata.push(name.to_owned());
    }
    Ok(errata)
}

/// Reads `expect`.
pub(super) fn expect(value: Option<&Value<'_>>) -> Res<Option<Refusal>> {
    const REFUSALS: [(&str, Refusal); 5] = [
        ("cannot-assemble", Refusal::CannotAssemble),
        ("indeterminate", Refusal::Indeterminate),
        ("ambiguous", Refusal::Ambiguous),
        ("locked", Refusal::Locked),
        ("no-equilibrium", Refusal::NoEquilibrium),
    ];
    let Some(value) = value else { return Ok(None) };
    let name = value.text("the name of a refusal")?;
    match REFUSALS.iter().find(|(known, _)| *known == name) {
        Some((_, refusal)) => Ok(Some(*refusal)),
        None => Err(Fault::new(value.at, format!("`{name}` is no refusal"))
            .known(name, REFUSALS.iter().map(|(known, _)| *known))),
    }
}
