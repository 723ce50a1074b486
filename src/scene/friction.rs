//! What rubs: `f` and `circle` of `pins`, `f` and `drag` of `slides`.

use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::json::{Entry, Fields, Kind, Value};
use super::keys;
use super::spin;
use super::units::Measure;
use crate::mechanism::force::Party;
use crate::mechanism::friction::{FrictionCircle, Resistance, Roughness, RubbingPin, RubbingSlide};
use crate::mechanism::{Given, Input};

/// An angle of friction lies below this, radians.
const UPRIGHT: f64 = std::f64::consts::FRAC_PI_2;

/// Reads what rubs. Called when links and sliding pairs are known and the scene has forces.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    if let Some(pins) = scene.get("pins") {
        for Entry { at, key, value } in pins.object("journals of pins, by name")? {
            pin(*at, key, value, draft)?;
        }
    }
    if let Some(slides) = scene.get("slides") {
        for (index, item) in slides.list("a list of sliding pairs")?.iter().enumerate() {
            let fields = Fields::of(item, keys::SLIDE, "a sliding pair")?;
            let roughness = fields.get("f").map(|f| roughness(f, draft)).transpose()?.flatten();
            if let (Some(_), Some(f)) = (roughness, fields.entry("f")) {
                not_between_halves(index, f.at, draft)?;
            }
            // In a governor that rests it is that of the sleeve, and read with it; a half that is drawn has its part.
            let governs = scene.entry("spin").is_some();
            let drag = fields.get("drag").filter(|_| !governs || spin::moves(draft));
            let drag = drag.map(|drag| drag_of(drag, draft)).transpose()?.flatten();
            let halves = draft.mechanism.forces.spin.map_or(1.0, |spin| f64::from(spin.balls));
            let drag = drag.map(|drag| match halves == 1.0 {
                true => drag,
                false => Given::read(drag.value / halves).with_room((drag.error + drag.low.abs()) / halves),
            });
            let resistance = match (roughness, drag) {
                (Some(roughness), Some(drag)) => Resistance::Both(roughness, drag),
                (Some(roughness), None) => Resistance::Friction(roughness),
                (None, Some(drag)) => Resistance::Drag(drag),
                (None, None) => continue,
            };
            draft.mechanism.forces.friction.slides.push(RubbingSlide { slide: index, resistance });
        }
    }
    if draft.mechanism.forces.friction.is_empty() {
        return Ok(());
    }
    let at_rest = |input: &Input| match input {
        Input::Angle { omega, .. } => omega.value == 0.0,
        Input::Speed { speed, .. } => speed.value == 0.0,
        Input::Slide { velocity, .. } => velocity.value == 0.0,
    };
    if draft.mechanism.inputs.iter().all(at_rest) {
        if draft.mechanism.forces.spin.is_some() {
            return imagine_a_motion(scene, draft);
        }
        let at = scene.entry("input").or(scene.entry("inputs")).map_or(0, |entry| entry.at);
        return Err(Fault::new(at, "friction is against a motion, and no input moves").mend(
            "give the input an `omega` (or `velocity`) of any size: it says in which sense everything moves",
        ));
    }
    Ok(())
}

/// A governor that rests in its plane is about to move: an input that moves at a unit rate says in which senses, and nothing
/// else.
fn imagine_a_motion(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let unit = Given::exact(1.0);
    if let Some(input) = draft.mechanism.inputs.first_mut() {
        match input {
            Input::Angle { omega, .. } => *omega = unit,
            Input::Speed { speed, .. } => *speed = unit,
            Input::Slide { velocity, .. } => *velocity = unit,
        }
    }
    let sleeve = draft.mechanism.sleeve_slide();
    let Some(spin) = &mut draft.mechanism.forces.spin else { return Ok(()) };
    spin.imagined = true;
    if sleeve.is_none() {
        let at = scene.entry("spin").map_or(0, |entry| entry.at);
        let what =
            "friction is against a motion, and no sleeve says which way this governor is about to move";
        return Err(Fault::new(at, what).mend(
            "name the link that slides on the frame as `sleeve`, or give the input a rate of any size",
        ));
    }
    Ok(())
}

/// What presses a sleeve against its guide is not told by one of several halves: they hold each other.
fn not_between_halves(slide: usize, at: usize, draft: &Draft<'_>) -> Res<()> {
    let m = &draft.mechanism;
    let shared = |party: Party| match party {
        Party::Link(link) => m.shared_by(link) != 1.0,
        Party::Pin(_) => false,
    };
    let pair = &m.slides[slide];
    if shared(m.party_of(&pair.rider)) || shared(Party::Link(pair.guide.link)) {
        let what = "the halves of a governor hold their sleeve in balance across its guide: nothing presses it there";
        return Err(
            Fault::new(at, what).mend("give its resistance as `drag`, or draw the whole with \"balls\": 1")
        );
    }
    Ok(())
}

fn pin(at: usize, key: &str, value: &Value<'_>, draft: &mut Draft<'_>) -> Res<()> {
    let fields = Fields::of(value, keys::PIN, "a journal")?;
    let point = draft.point_named(key, at)?;
    let circle = match (fields.get("circle"), fields.entry("f")) {
        (Some(circle), None) => {
            let radius = draft.scales.given(circle, Measure::Length)?;
            if radius.value < 0.0 {
                return Err(Fault::new(circle.at, "the radius of a friction circle is not negative"));
            }
            (radius.value > 0.0).then_some(FrictionCircle::Radius(radius))
        }
        (None, Some(f)) => {
            let Some(radius) = draft.mechanism.points[point.0].journal else {
                return Err(Fault::new(
                    f.at,
                    "`f` without the radius of the journal says no friction circle",
                )
                .mend("give `radius` or `diameter` beside it, or the `circle` itself"));
            };
            roughness(&f.value, draft)?.map(|roughness| FrictionCircle::Journal { radius, roughness })
        }
        (Some(_), Some(f)) => {
            return Err(Fault::new(f.at, "a pin has `f` with its radius, or its `circle`, not both"));
        }
        (None, None) => None,
    };
    let Some(circle) = circle else { return Ok(()) };
    let m = &draft.mechanism;
    let name = draft.say_point(point);
    if m.point(point).links.len() < 2 {
        let fault = Fault::new(at, format!("{name} is a pin of one link only: nothing turns on it"));
        return Err(fault.mend("what rubs in a slot is `f` of its sliding pair"));
    }
    if m.rubbing_carrier(point).is_none() {
        let what = format!("several links turn on the pin {name}: which of them it rubs on is not said");
        let example = m.point(point).links.first().map_or(0, |link| m.link(*link).number);
        return Err(Fault::new(at, what)
            .mend(format!("say which link holds the pin: \"{key}\": {{…, \"carrier\": {example}}}")));
    }
    draft.mechanism.forces.friction.pins.push(RubbingPin { pin: point, circle });
    Ok(())
}

/// A coefficient, or an angle with its unit; none where it is zero.
fn roughness(value: &Value<'_>, draft: &Draft<'_>) -> Res<Option<Roughness>> {
    let expected = "a coefficient of friction such as 0.1, or its angle such as \"6 deg\"";
    let coefficient = match &value.kind {
        Kind::Number(digits) => Given::decimal(digits),
        Kind::Text(text) => Given::decimal(text.trim()),
        _ => return Err(value.unexpected(expected)),
    };
    if let Some(f) = coefficient {
        if f.value < 0.0 || !f.value.is_finite() {
            return Err(Fault::new(value.at, "a coefficient of friction is not negative"));
        }
        return Ok((f.value > 0.0).then_some(Roughness::Coefficient(f)));
    }
    let angle = draft.scales.given(value, Measure::Angle)?;
    if angle.value < 0.0 || angle.value >= UPRIGHT {
        return Err(Fault::new(value.at, "an angle of friction lies between 0 and 90 degrees"));
    }
    Ok((angle.value > 0.0).then_some(Roughness::Angle(angle)))
}

/// A constant force against sliding; none where it is zero.
fn drag_of(value: &Value<'_>, draft: &Draft<'_>) -> Res<Option<Given>> {
    let drag = draft.scales.given(value, Measure::Force)?;
    if drag.value < 0.0 {
        return Err(Fault::new(value.at, "a drag is against sliding whatever its sense, and not negative"));
    }
    Ok((drag.value > 0.0).then_some(drag))
}
