//! Governors: `spin`, and the `drag` of their sleeves.

use super::diagnostic::{Fault, Res};
use super::draft::{Draft, is_straight};
use super::json::{Fields, Kind, Value};
use super::keys;
use super::units::Measure;
use crate::mechanism::force::Party;
use crate::mechanism::quantity::Order;
use crate::mechanism::spin::{Drag, Spin, SpinSpeed};
use crate::mechanism::{Given, Input, LinkId};

/// No governor has more balls.
const MOST_BALLS: u32 = 100;

/// Reads `spin`.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = scene.get("spin") else { return Ok(()) };
    let fields = Fields::of(value, keys::SPIN, "a governor: {\"axis\": {…}, \"omega\": …, \"sleeve\": 4}")?;
    let axis = fields.need("axis", "the axis about which the plane turns")?;
    let axis = Fields::of(axis, keys::AXIS, "an axis: {\"through\": [0, 0], \"angle\": 90}")?;
    let through = draft.scales.place(axis.need("through", "a point of the axis, in the world")?)?;
    let angle =
        draft.scales.given(axis.need("angle", "the direction of the axis, from +x")?, Measure::Angle)?;
    let omega = fields.need("omega", "how fast the plane turns, or \"?\"")?;
    let omega = match &omega.kind {
        Kind::Text(text) if text.trim() == "?" => SpinSpeed::Sought,
        _ => {
            let bare = draft.scales.bare(Measure::AngularVelocity);
            let stated = draft.scales.stated(omega, Measure::AngularVelocity, true, bare)?;
            draft.spin_unit = Some(stated.scale.unit());
            SpinSpeed::Given(draft.scales.given(omega, Measure::AngularVelocity)?)
        }
    };
    let balls = match fields.get("balls") {
        None => 1,
        Some(balls) => {
            let number = match &balls.kind {
                Kind::Number(digits) => digits.parse().ok().filter(|n| (1..=MOST_BALLS).contains(n)),
                _ => None,
            };
            number.ok_or_else(|| {
                Fault::new(
                    balls.at,
                    format!(
                        "a whole number from 1 to {MOST_BALLS} is expected: of so many halves one is drawn"
                    ),
                )
            })?
        }
    };
    let sleeve = fields.get("sleeve").map(|sleeve| draft.moving_link(sleeve)).transpose()?;
    if draft.mechanism.forces.masses.is_empty() {
        return Err(
            Fault::new(value.at, "nothing has a mass: the axis drives nothing away").mend("give `masses`")
        );
    }
    let drag = drag(scene, sleeve, draft)?;
    draft.mechanism.forces.spin = Some(Spin { through, angle, omega, balls, sleeve, drag, imagined: false });
    Ok(())
}

/// Refuses questions about a motion that is only imagined, for the senses of friction.
pub(super) fn refuse_rates(find: Option<&Value<'_>>, draft: &Draft<'_>) -> Res<()> {
    let m = &draft.mechanism;
    if !m.forces.spin.is_some_and(|spin| spin.imagined) {
        return Ok(());
    }
    let moves = |asked: &&crate::mechanism::quantity::Asked| asked.quantity.order() != Order::Position;
    match (m.asked.iter().find(moves), find) {
        (Some(asked), Some(find)) => {
            let what = format!("`{}`: this governor rests in its own plane", asked.name);
            Err(Fault::new(find.at, what).mend("give the input a rate, or ask for speeds and forces only"))
        }
        _ => Ok(()),
    }
}

/// The `drag` of the pair in which the sleeve rides.
fn drag(scene: &Fields<'_, '_>, sleeve: Option<LinkId>, draft: &Draft<'_>) -> Res<Option<Drag>> {
    let Some(list) = scene.get("slides") else { return Ok(None) };
    let mut found = None;
    for (slide, item) in list.list("the sliding pairs")?.iter().enumerate() {
        let Kind::Object(entries) = &item.kind else { continue };
        let Some(entry) = entries.iter().find(|entry| entry.key == "drag") else { continue };
        let pair = draft.mechanism.slides.get(slide);
        let of_sleeve = |pair: &&crate::mechanism::Slide| match draft.mechanism.party_of(&pair.rider) {
            Party::Link(rider) => sleeve == Some(rider),
            Party::Pin(_) => false,
        };
        let Some(pair) = pair.filter(of_sleeve) else {
            return Err(Fault::new(entry.at, "in a governor this version does drag of the `sleeve` only")
                .mend("leave it out, or name the link that slides here as `sleeve`"));
        };
        if !is_straight(&pair.guide) {
            return Err(Fault::new(entry.at, "a sleeve slides on a straight guide"));
        }
        let size: Given = positive(&entry.value, draft)?;
        if moves(draft) {
            // The motion itself says in which sense the sleeve slides: the drag is read with what rubs.
            continue;
        }
        found = Some(Drag { slide, size });
    }
    Ok(found)
}

/// Whether inputs move: their motion says in which sense the sleeve slides.
pub(super) fn moves(draft: &Draft<'_>) -> bool {
    let rests = |input: &Input| match input {
        Input::Angle { omega, .. } => omega.value == 0.0,
        Input::Speed { speed, .. } => speed.value == 0.0,
        Input::Slide { velocity, .. } => velocity.value == 0.0,
    };
    !draft.mechanism.inputs.iter().all(rests)
}

fn positive(value: &Value<'_>, draft: &Draft<'_>) -> Res<Given> {
    let given = draft.scales.given(value, Measure::Force)?;
    if given.value > 0.0 { Ok(given) } else { Err(Fault::new(value.at, "a drag must be greater than zero")) }
}
