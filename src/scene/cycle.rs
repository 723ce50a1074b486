//! The turning-moment diagram: `cycle`, curves over the input's angle, and the names of what may be asked of it.

use super::InputUnits;
use super::diagnostic::{Fault, Res};
use super::draft::Draft;
use super::forces::effort_of_link;
use super::json::{Entry, Fields, Kind, Value};
use super::keys;
use super::units::{Measure, number};
use crate::limits::KNOTS;
use crate::mechanism::curve::{Curve, Harmonic};
use crate::mechanism::cycle::{Copies, Course, Cycle, CycleQuantity, Rotating, RotatingInertia, Sides};
use crate::mechanism::quantity::Quantity;
use crate::mechanism::{Given, Input};

/// The numbers of a turning-moment diagram that a scene may ask for, besides those whose heads others share.
pub(super) const CYCLE: [(&str, &str); 19] = [
    ("Tmean", "mean of the driving torque of the cycle"),
    ("E", "work of the driving torque in a period of the cycle"),
    ("power", "mean torque of the cycle times mean speed"),
    ("Emax", "highest level of energy in the cycle, from angle 0"),
    ("Emin", "lowest level of energy in the cycle, from angle 0"),
    ("Ef", "fluctuation of energy, Emax − Emin"),
    ("Ke", "coefficient of fluctuation of energy, Ef/|E|"),
    ("Ks", "coefficient of fluctuation of speed, Ef/(I ω²)"),
    ("If", "moment of inertia of the flywheel that is still needed at the input"),
    ("crossing(2)", "angle of the second crossing of torque and load, from 0"),
    ("area(2)", "work between the curves from crossing 2 to the next"),
    ("level(2)", "level of energy at crossing 2; of given areas, after area 2"),
    ("I", "moment of inertia of `rotating`, referred to the input"),
    ("angle(Emax)", "angle at the highest level of the cycle"),
    ("angle(Emin)", "angle at the lowest level of the cycle"),
    ("angle(alpha_max)", "angle of the cycle at alpha(max)"),
    ("angle(alpha_min)", "angle of the cycle at alpha(min)"),
    ("alpha(max)", "greatest angular acceleration of the input in the cycle"),
    ("alpha(min)", "least angular acceleration of the input in the cycle"),
];

/// Crossings, areas and levels are numbered up to here.
const MOST: u32 = 1_000_000;
/// No cycle has more copies of its curves.
const MOST_COPIES: u32 = 1000;

/// What every number of a diagram is named.
fn quantity(name: &str) -> Option<CycleQuantity> {
    let plain: String = name.chars().filter(|c| !c.is_whitespace()).collect();
    Some(match plain.as_str() {
        "Tmean" => CycleQuantity::Mean,
        "E" => CycleQuantity::Work,
        "power" => CycleQuantity::Power,
        "Emax" => CycleQuantity::Highest,
        "Emin" => CycleQuantity::Lowest,
        "Ef" => CycleQuantity::Fluctuation,
        "Ke" => CycleQuantity::OfEnergy,
        "Ks" => CycleQuantity::OfSpeed,
        "If" => CycleQuantity::Flywheel,
        "I" => CycleQuantity::Inertia,
        "angle(Emax)" => CycleQuantity::AtHighest,
        "angle(Emin)" => CycleQuantity::AtLowest,
        "alpha(max)" => CycleQuantity::Most,
        "alpha(min)" => CycleQuantity::Least,
        "angle(alpha_max)" => CycleQuantity::AtMost,
        "angle(alpha_min)" => CycleQuantity::AtLeast,
        other => {
            let (head, k) = other.strip_suffix(')')?.split_once('(')?;
            let k = k.parse().ok().filter(|k| (1..=MOST).contains(k) && k.to_string().len() <= 7)?;
            match head {
                "crossing" => CycleQuantity::Crossing(k),
                "area" => CycleQuantity::Area(k),
                "level" => CycleQuantity::Level(k),
                _ => return None,
            }
        }
    })
}

/// Reads the name of a number of the diagram; `None` where it is none.
pub(super) fn parse(name: &str, at: usize, draft: &Draft<'_>) -> Res<Option<Quantity>> {
    let fault = |what: &str| Fault::new(at, format!("`{name}`: {what}"));
    let Some(of) = quantity(name) else {
        let head = name.split('(').next().unwrap_or_default().trim();
        if matches!(head, "crossing" | "area" | "level") {
            return Err(
                fault("the number of a crossing is expected, from 1").mend(format!("write {head}(2)"))
            );
        }
        return Ok(None);
    };
    let Some(cycle) = &draft.mechanism.forces.cycle else {
        return Err(
            fault("the scene has no turning-moment diagram").mend("give `cycle` (`linkgram help forces`)")
        );
    };
    if of.hangs_on_mean() && !cycle.has_mean() {
        return Err(fault("areas between the curve and its mean do not tell the mean")
            .mend("give `total`, the whole area under the curve"));
    }
    if of == CycleQuantity::Flywheel && cycle.fluctuation.is_none() {
        return Err(
            fault("no fluctuation of speed is wanted").mend("give `fluctuation` in `cycle`: 0.02 for ±1 %")
        );
    }
    if of == CycleQuantity::Inertia && cycle.rotating.is_empty() {
        return Err(fault("nothing is said of what turns").mend("give `rotating` in `cycle`"));
    }
    Ok(Some(Quantity::Cycle(of)))
}

/// What a diagram is asked where the scene has no `find`.
pub(super) fn everything(cycle: &Cycle) -> Vec<CycleQuantity> {
    let mut all = vec![CycleQuantity::Mean, CycleQuantity::Work];
    if cycle.omega.value != 0.0 {
        all.push(CycleQuantity::Power);
    }
    all.extend([
        CycleQuantity::Highest,
        CycleQuantity::Lowest,
        CycleQuantity::Fluctuation,
        CycleQuantity::OfEnergy,
    ]);
    all.retain(|of| cycle.has_mean() || !of.hangs_on_mean());
    if !cycle.rotating.is_empty() {
        all.push(CycleQuantity::Inertia);
    }
    if cycle.omega.value != 0.0 {
        if cycle.fluctuation.is_some() {
            all.push(CycleQuantity::Flywheel);
        } else if !cycle.rotating.is_empty() {
            all.push(CycleQuantity::OfSpeed);
        }
    }
    all
}

/// Whether a scene is a diagram and nothing else: it needs no links.
pub(super) fn is_alone(scene: &Fields<'_, '_>, draft: &Draft<'_>) -> bool {
    scene.entry("cycle").is_some() && draft.mechanism.moving().next().is_none()
}

/// Reads `cycle`.
pub(super) fn read(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<()> {
    let Some(value) = scene.get("cycle") else { return Ok(()) };
    let fields = Fields::of(value, keys::CYCLE, "a cycle: {\"torque\": …, \"period\": …}")?;
    let omega = speed(scene, draft)?;
    let period = match fields.get("period") {
        Some(period) => whole_period(period, draft)?,
        None => turn(),
    };
    let sides = sides(&fields, value, period, draft)?;
    let copies = match fields.get("copies") {
        Some(copies) => self::copies(copies, draft)?,
        None => Copies { number: 1, shift: Given::exact(0.0) },
    };
    if let (Sides::Areas { .. }, Some(entry)) = (&sides, fields.entry("copies")) {
        return Err(Fault::new(entry.at, "areas cannot be copied: they do not say where they stand")
            .mend("give the areas of the sum"));
    }
    let rotating = match fields.get("rotating") {
        Some(list) => list
            .list("a list of what turns: [{\"mass\": …, \"gyration\": …}]")?
            .iter()
            .map(|item| rotating(item, draft))
            .collect::<Res<Vec<_>>>()?,
        None => Vec::new(),
    };
    let fluctuation = fields
        .get("fluctuation")
        .map(|value| {
            let given = draft.scales.given(value, Measure::Number)?;
            if given.value > 0.0 && given.value < 2.0 {
                return Ok(given);
            }
            Err(Fault::new(value.at, "the fluctuation of speed lies between 0 and 2")
                .mend("±1 % of the mean speed is 0.02"))
        })
        .transpose()?;
    let falling = omega.value < 0.0 && !is_alone(scene, draft);
    draft.mechanism.forces.cycle =
        Some(Cycle { sides, period, copies, rotating, fluctuation, omega, falling });
    Ok(())
}

/// The mean speed of the input: of a diagram alone `{"omega": …}`.
fn speed(scene: &Fields<'_, '_>, draft: &mut Draft<'_>) -> Res<Given> {
    if !is_alone(scene, draft) {
        return match draft.mechanism.inputs.first() {
            Some(Input::Angle { omega, .. }) => Ok(*omega),
            Some(Input::Speed { .. }) => {
                let at = scene.entry("input").or(scene.entry("inputs")).map_or(0, |entry| entry.at);
                Err(Fault::new(at, "a turning-moment diagram needs the `omega` of the input")
                    .mend("give `omega` in the place of `speed`"))
            }
            Some(Input::Slide { .. }) | None => {
                let at = scene.entry("cycle").map_or(0, |entry| entry.at);
                Err(Fault::new(at, "a turning-moment diagram is drawn over the angle of a driven link")
                    .mend("drive a link in `input`"))
            }
        };
    }
    if let Some(entry) = scene.entry("inputs") {
        return Err(Fault::new(entry.at, "a diagram without links has one `input`: {\"omega\": …}"));
    }
    let Some(value) = scene.get("input") else { return Ok(Given::exact(0.0)) };
    let fields =
        Fields::of(value, &["omega"], "the speed of a diagram without links: {\"omega\": \"300 rpm\"}")?;
    let Some(omega) = fields.get("omega") else { return Ok(Given::exact(0.0)) };
    let bare = draft.scales.bare(Measure::AngularVelocity);
    let rate = draft.scales.stated(omega, Measure::AngularVelocity, true, bare)?.scale.unit();
    draft.input_units.push(InputUnits { rate: Some(rate), ..InputUnits::default() });
    draft.scales.given(omega, Measure::AngularVelocity)
}

fn whole_period(value: &Value<'_>, draft: &Draft<'_>) -> Res<Given> {
    let period = draft.scales.whole_angle(value)?;
    let most = 100.0 * std::f64::consts::TAU;
    if period.value > 0.0 && period.value <= most {
        return Ok(period);
    }
    Err(Fault::new(value.at, "a period is an angle greater than zero, and no more than 100 turns"))
}

fn sides(fields: &Fields<'_, '_>, value: &Value<'_>, period: Given, draft: &Draft<'_>) -> Res<Sides> {
    let load = fields.get("load").map(|load| course(load, period, draft)).transpose()?;
    let Some(torque) = fields.get("torque") else {
        return load.map(Sides::Load).ok_or_else(|| {
            Fault::new(value.at, "`torque` or `load` is missing")
                .mend("give one of them: {\"of\": 2}, a `table`, `harmonics`, or `areas`")
        });
    };
    let of_areas = match &torque.kind {
        Kind::Object(entries) => entries.iter().any(|entry| entry.key == "areas"),
        _ => false,
    };
    if of_areas {
        if let Some(entry) = fields.entry("load") {
            return Err(Fault::new(
                entry.at,
                "areas lie between the torque and its mean: there is no other load",
            ));
        }
        return areas(torque, draft);
    }
    let torque = course(torque, period, draft)?;
    match load {
        None => Ok(Sides::Torque(torque)),
        Some(load) => {
            if let (Course::Of(_), Course::Of(_)) = (&torque, &load) {
                let at = fields.entry("load").map_or(value.at, |entry| entry.at);
                return Err(Fault::new(at, "the mechanism cannot be both sides of its own diagram")
                    .mend("leave one out: it is the mean of the other"));
            }
            Ok(Sides::Both { torque, load })
        }
    }
}

const COURSE: &str = "a torque over the angle: {\"of\": 2}, {\"table\": […]}, {\"harmonics\": {…}}";

fn course(value: &Value<'_>, period: Given, draft: &Draft<'_>) -> Res<Course> {
    let fields = Fields::of(value, keys::COURSE, COURSE)?;
    match fields.entry("of") {
        Some(Entry { at, value: of, .. }) => {
            fields.refuse(&["table", "harmonics"], "the mechanism gives the torque")?;
            let link = draft.moving_link(of)?;
            if draft.mechanism.forces.is_empty() {
                return Err(Fault::new(*at, "nothing acts on the mechanism: it gives no torque")
                    .mend("give `loads`, `masses` or `springs`"));
            }
            if !draft.mechanism.named_sought().is_empty() {
                return Err(Fault::new(
                    *at,
                    "the input has no effort of its own where something else is sought",
                )
                .mend("give it a size"));
            }
            if effort_of_link(link, draft) != Some(0) {
                return Err(Fault::new(
                    of.at,
                    format!("{} is not driven by the first input", draft.say(link)),
                )
                .mend("name the link of the first input"));
            }
            loads_come_again(*at, period, draft)?;
            Ok(Course::Of(link))
        }
        None => Ok(Course::Curve(curve(&fields, value, Measure::Torque, period, draft)?)),
    }
}

/// What the mechanism gives comes again when the curves of its loads do.
fn loads_come_again(at: usize, period: Given, draft: &Draft<'_>) -> Res<()> {
    let mechanism = &draft.mechanism;
    if mechanism.forces.curves.is_empty() {
        return Ok(());
    }
    let turns = mechanism.turns_of_loads();
    let whole = turns.is_some_and(|turns| {
        let times = period.value / (f64::from(turns) * std::f64::consts::TAU);
        (times - libm::round(times)).abs() < 1e-9 && libm::round(times) >= 1.0
    });
    if whole {
        return Ok(());
    }
    let what = match turns {
        Some(turns) => format!("with its loads the mechanism comes round after {turns} turns, and no sooner"),
        None => "the mechanism and its loads never come round together".to_owned(),
    };
    Err(Fault::new(at, what)
        .mend("give the `period` of the diagram as an angle after which the loads come again"))
}

/// The size of a load over the angle of the first input: its period is that of the diagram, or one turn, where it says
/// none.
pub(super) fn curve_of_load(
    value: &Value<'_>,
    of: Measure,
    scene: &Fields<'_, '_>,
    draft: &Draft<'_>,
) -> Res<Curve> {
    let fields = Fields::of(
        value,
        keys::CURVE,
        "a size over the angle of the input: {\"table\": [[0, …]]}, {\"harmonics\": {…}}",
    )?;
    match draft.mechanism.inputs.first() {
        Some(Input::Angle { link, angle, .. } | Input::Speed { link, angle, .. }) => {
            if angle.is_none() && draft.link(*link).points.len() < 2 {
                return Err(Fault::new(value.at, format!("nothing tells the angle of {}", draft.say(*link)))
                    .mend("give the `angle` of the input"));
            }
        }
        Some(Input::Slide { .. }) | None => {
            return Err(Fault::new(
                value.at,
                "a load changes with the angle of a driven link, and the first input is none",
            )
            .mend("drive a link in `input`, or give the size at this instant"));
        }
    }
    let period = match (fields.get("period"), scene.get("cycle").map(|cycle| &cycle.kind)) {
        (Some(period), _) => whole_period(period, draft)?,
        (None, Some(Kind::Object(entries))) => match entries.iter().find(|entry| entry.key == "period") {
            Some(entry) => whole_period(&entry.value, draft)?,
            None => turn(),
        },
        (None, _) => turn(),
    };
    curve(&fields, value, of, period, draft)
}

/// One turn.
fn turn() -> Given {
    Given { value: std::f64::consts::TAU, error: f64::EPSILON * 2.0, low: 0.0, low_error: f64::EPSILON * 2.0 }
}

/// A `table` or `harmonics` of some measure.
pub(super) fn curve(
    fields: &Fields<'_, '_>,
    value: &Value<'_>,
    of: Measure,
    period: Given,
    draft: &Draft<'_>,
) -> Res<Curve> {
    match (fields.get("table"), fields.entry("harmonics")) {
        (Some(_), Some(entry)) => Err(Fault::new(entry.at, "a curve is a `table` or `harmonics`, not both")),
        (None, None) => Err(Fault::new(value.at, "the curve is missing")
            .mend("give a `table`: [[0, …], [60, …]], or `harmonics`")),
        (Some(list), None) => table(list, of, period, draft),
        (None, Some(entry)) => harmonics(&entry.value, of, period, draft),
    }
}

fn table(list: &Value<'_>, of: Measure, period: Given, draft: &Draft<'_>) -> Res<Curve> {
    let items = list.list("knots: [[angle, size], …]")?;
    if items.is_empty() || items.len() > KNOTS {
        return Err(Fault::new(list.at, format!("a table has 1 to {KNOTS} knots")));
    }
    let mut knots: Vec<[Given; 2]> = Vec::new();
    for item in items {
        let [at, size] = item.list("a knot [angle, size]")? else {
            return Err(Fault::new(item.at, "a knot is an angle and a size: [60, 800]"));
        };
        let (angle, size) = (draft.scales.whole_angle(at)?, draft.scales.given(size, of)?);
        let same = |known: &[Given; 2]| known[0].value == angle.value;
        if knots.last().is_some_and(|last| last[0].value > angle.value) {
            return Err(Fault::new(at.at, "the angles of a table ascend"));
        }
        if knots.iter().filter(|known| same(known)).count() > 1 {
            return Err(Fault::new(at.at, "an angle stands twice where the curve leaps, and not more often"));
        }
        let first = knots.first().map_or(angle.value, |first| first[0].value);
        if angle.value - first > period.value * (1.0 + 4.0 * f64::EPSILON) {
            return Err(
                Fault::new(at.at, "the table is longer than its period").mend("give a longer `period`")
            );
        }
        knots.push([angle, size]);
    }
    Ok(Curve::Table { knots, period })
}

fn harmonics(value: &Value<'_>, of: Measure, period: Given, draft: &Draft<'_>) -> Res<Curve> {
    let fields = Fields::of(
        value,
        keys::HARMONICS,
        "harmonics: {\"constant\": c, \"sin\": [[2, s2]], \"cos\": [[1, c1]]}",
    )?;
    let constant = fields.get("constant").map_or(Ok(Given::exact(0.0)), |c| draft.scales.given(c, of))?;
    let waves = |key: &str| -> Res<Vec<Harmonic>> {
        let Some(list) = fields.get(key) else { return Ok(Vec::new()) };
        let items = list.list("harmonics: [[order, size], …]")?.iter();
        items
            .map(|item| {
                let [order, size] = item.list("a harmonic [order, size]")? else {
                    return Err(Fault::new(item.at, "a harmonic is an order and a size: [2, 675]"));
                };
                let Kind::Number(digits) = order.kind else {
                    return Err(order.unexpected("the order of a harmonic, waves in a turn of the input"));
                };
                let wave = number(digits, order.at)?;
                let waves = wave.value * period.value / std::f64::consts::TAU;
                if !(wave.value > 0.0 && wave.value <= 1000.0 && (waves - waves.round()).abs() < 1e-9) {
                    return Err(Fault::new(order.at, "a period must hold a whole number of waves")
                        .mend("the order counts waves in one turn of the input; four-stroke engines have halves, with \"period\": 720"));
                }
                // Whole and half orders are exact.
                Ok(Harmonic { order: Given::exact(wave.value), size: draft.scales.given(size, of)? })
            })
            .collect()
    };
    let (sin, cos) = (waves("sin")?, waves("cos")?);
    Ok(Curve::Harmonics { constant, sin, cos })
}

fn areas(value: &Value<'_>, draft: &Draft<'_>) -> Res<Sides> {
    let fields = Fields::of(value, keys::AREAS, "areas: {\"areas\": […], \"scale\": {…}, \"total\": …}")?;
    let items =
        fields.need("areas", "the areas between the curve and its mean, from the first crossing on")?;
    let list = items.list("a list of areas")?;
    if list.is_empty() || list.len() > KNOTS {
        return Err(Fault::new(items.at, format!("1 to {KNOTS} areas")));
    }
    let areas = list.iter().map(|area| draft.scales.given(area, Measure::Number)).collect::<Res<Vec<_>>>()?;
    let scale = fields.need("scale", "what a unit of length of the paper stands for")?;
    let scale =
        Fields::of(scale, keys::AREA_SCALE, "a scale: {\"torque\": \"150 N*m\", \"angle\": \"12 deg\"}")?;
    let torque = scale.need("torque", "the torque of a unit of length")?;
    let torque = positive(torque, draft.scales.given(torque, Measure::Torque)?)?;
    let angle = scale.need("angle", "the angle of a unit of length")?;
    let angle = positive(angle, draft.scales.whole_angle(angle)?)?;
    let total = fields.get("total").map(|total| draft.scales.given(total, Measure::Number)).transpose()?;
    Ok(Sides::Areas { areas, torque, angle, total })
}

fn positive(value: &Value<'_>, given: Given) -> Res<Given> {
    if given.value > 0.0 { Ok(given) } else { Err(Fault::new(value.at, "it must be greater than zero")) }
}

fn copies(value: &Value<'_>, draft: &Draft<'_>) -> Res<Copies> {
    let fields = Fields::of(value, keys::COPIES, "copies: {\"number\": 3, \"shift\": 120}")?;
    let number = fields.need("number", "how many curves there are in all")?;
    let count = match &number.kind {
        Kind::Number(digits) => digits.parse::<u32>().ok().filter(|n| (1..=MOST_COPIES).contains(n)),
        _ => None,
    };
    let count = count.ok_or_else(|| {
        Fault::new(number.at, format!("a whole number from 1 to {MOST_COPIES} is expected"))
    })?;
    let shift = fields.need("shift", "by which angle each curve follows the one before")?;
    Ok(Copies { number: count, shift: draft.scales.whole_angle(shift)? })
}

fn rotating(value: &Value<'_>, draft: &Draft<'_>) -> Res<Rotating> {
    let fields =
        Fields::of(value, keys::ROTATING, "what turns: {\"mass\": …, \"gyration\": …, \"ratio\": …}")?;
    let read = |value: &Value<'_>, measure| positive(value, draft.scales.given(value, measure)?);
    let ratio = match fields.get("ratio") {
        Some(ratio) => {
            let given = draft.scales.given(ratio, Measure::Number)?;
            if given.value == 0.0 {
                return Err(Fault::new(ratio.at, "what does not turn has no place here"));
            }
            given
        }
        None => Given::exact(1.0),
    };
    let inertia = match (fields.get("inertia"), fields.get("mass"), fields.get("weight")) {
        (Some(inertia), None, None) => {
            fields.refuse(&["gyration"], "the moment of inertia is given")?;
            RotatingInertia::Central(read(inertia, Measure::Inertia)?)
        }
        (None, Some(mass), None) => {
            let radius = fields.need("gyration", "the radius of gyration")?;
            RotatingInertia::Mass(read(mass, Measure::Mass)?, read(radius, Measure::Length)?)
        }
        (None, None, Some(weight)) => {
            let radius = fields.need("gyration", "the radius of gyration")?;
            RotatingInertia::Weight(read(weight, Measure::Force)?, read(radius, Measure::Length)?)
        }
        (None, None, None) => {
            return Err(Fault::new(value.at, "`inertia`, `mass` or `weight` is missing"));
        }
        _ => return Err(Fault::new(value.at, "`inertia`, `mass` and `weight` exclude each other")),
    };
    Ok(Rotating { inertia, ratio })
}
