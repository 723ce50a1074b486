//! `linkgram solve`.

use std::fmt::Write;
use std::io::Write as _;
use std::path::PathBuf;

use serde_json::{Map, Value, json};

use super::{Ending, Failure, arguments, failure, print, read_scene};
use crate::check::{Agreement, Compared};
use crate::double_double::DoubleDouble;
use crate::graphical::construction::{Construction, Fine};
use crate::graphical::{Draughtsmen, HandError};
use crate::mechanism::friction::{Rub, RubbedBy, RubbingPair};
use crate::mechanism::quantity::{Answer, Asked, Measure, Method, Nature, Quantity};
use crate::plan::Extent;
use crate::report::{short, significant, two_digits};
use crate::scene::{Scene, SheetOptions};
use crate::solve::{Arithmetic, Hand, Settings};

/// What to solve and how to print it.
#[derive(Debug, clap::Args)]
pub(super) struct Job {
    /// The scene file; - for standard input
    pub(super) scene: PathBuf,
    /// Print one JSON object
    #[arg(long)]
    pub(super) json: bool,
    /// Say which steps the asked quantities needed, and which were left out
    #[arg(long)]
    pub(super) explain: bool,
    /// What a draughtsman would get whose lengths and readings slip by up to this many millimetres of
    /// paper, and whose directions by this many degrees
    #[arg(long, value_name = "MM,DEG", allow_hyphen_values = true, value_parser = arguments::hand)]
    pub(super) hand: Option<Hand>,
    /// Arithmetic of the drawing board: f32, f64, or dd (double-double, 31 digits)
    #[arg(long, value_name = "ARITHMETIC", default_value = "f64", value_parser = arguments::arithmetic)]
    pub(super) arith: Arithmetic,
}

impl Job {
    fn settings(&self) -> Settings {
        Settings { arithmetic: self.arith, ..Settings::default() }
    }
}

/// So many draughtsmen with dice draw for `--hand`.
const DRAUGHTSMEN: u64 = 1000;

pub(super) fn run(job: &Job) -> Result<Ending, Failure> {
    let (file, scene) = read_scene(&job.scene)?;
    let scene = &scene;
    // Only a hand draws on paper; numbers depend on no scale.
    let solved = match job.hand {
        Some(_) => {
            let choose = crate::sheet::scale::for_scene;
            crate::solve::solve_with(scene, Extent::Asked, &[], job.settings(), choose).map(|mut solved| {
                let forces = crate::sheet::force_paper(scene, &solved.solution.construction);
                solved.scales = solved.scales.on(forces);
                solved
            })
        }
        None => crate::solve::solve_numbers(scene, job.settings()),
    }
    .map_err(|error| failure(scene, &error))?;
    let agreement = crate::check::agreement(scene, &solved, &crate::solve::solve_analytically(scene));
    let by_hand = match job.hand {
        Some(hand) => {
            let draughtsmen = Draughtsmen { hand, number: DRAUGHTSMEN };
            crate::solve::by_hand(scene, &solved, draughtsmen).map_err(|error| failure(scene, &error))?
        }
        None => Vec::new(),
    };
    let explanation = job.explain.then(|| {
        let circle = solved.solution.construction.circle.as_ref();
        let centres = circle.map_or_else(String::new, |c| c.explain(&scene.mechanism).to_string());
        solved.plan.explain(&scene.mechanism, &solved.structure).to_string() + &centres
    });
    let text = if job.json {
        let mut object = object(&file, scene, &solved, &agreement, &by_hand);
        if let (Some(explanation), Some(map)) = (&explanation, object.as_object_mut()) {
            let lines: Vec<&str> = explanation.lines().collect();
            map.insert("explain".to_owned(), json!(lines));
        }
        serde_json::to_string_pretty(&object).map_err(|error| Failure(error.to_string()))? + "\n"
    } else {
        table(&solved, &agreement, &by_hand, scene) + explanation.as_deref().unwrap_or("")
    };
    print(&text)?;
    let hints = crate::report::unheld_hints(scene, &solved.solution.construction);
    for note in hints.into_iter().chain(crate::report::light_gravity(scene)) {
        let _ = writeln!(std::io::stderr(), "note: {}", crate::terminal::lines(&note.to_string()));
    }
    let determined = agreement.compared.iter().all(|c| c.indeterminate().is_none());
    Ok(if agreement.ok() && determined { Ending::Fine } else { Ending::DoesNotHold })
}

/// As wide as a terminal usually is, at most.
const WIDEST: usize = 100;
/// Between two columns.
const GAP: &str = "  ";

fn table(
    solved: &crate::solve::Solved,
    agreement: &Agreement,
    by_hand: &[HandError],
    scene: &Scene,
) -> String {
    let units = &scene.units;
    let lines = |digits: usize| -> Vec<[String; 5]> {
        let head = ["quantity", "value", "direction", "other solver", "off/bound"].map(str::to_owned);
        let construction = &solved.solution.construction;
        let rows = agreement.compared.iter().map(|compared| cells(compared, construction, digits));
        std::iter::once(head).chain(rows).collect()
    };
    let widths = |rows: &[[String; 5]]| -> [usize; 5] {
        let fits = rows.iter().filter(|row| !row[1].is_empty());
        let mut widths = [0; 5];
        for row in fits {
            widths = std::array::from_fn(|column| widths[column].max(row[column].chars().count()));
        }
        widths
    };
    let total = |widths: [usize; 5]| widths.iter().sum::<usize>() + 4 * GAP.len();
    // Long numbers lose digits rather than their line; `--json` has them all.
    let rows =
        (3..=7).rev().map(lines).find(|rows| total(widths(rows)) <= WIDEST).unwrap_or_else(|| lines(3));
    let mut widths = widths(&rows);
    // A name that is too long has a line of its own.
    widths[0] = widths[0].min((WIDEST + widths[0]).saturating_sub(total(widths)).max("quantity".len()));
    let mut out = String::new();
    // A turning-moment diagram may have no mechanism.
    if solved.structure.mobility.links > 1 {
        let _ = writeln!(out, "{}\n", solved.structure.mobility);
    }
    for (index, [name, value, direction, other, off]) in rows.iter().enumerate() {
        let [first, second, third, fourth, fifth] = widths;
        let mut name = name.as_str();
        if value.is_empty() || name.chars().count() > first {
            let _ = writeln!(out, "{name}");
            name = "";
        }
        let line = format!(
            "{name:first$}{GAP}{value:second$}{GAP}{direction:third$}{GAP}{other:fourth$}{GAP}{off:>fifth$}"
        );
        if !value.is_empty() {
            let _ = writeln!(out, "{}", line.trim_end());
        }
        // The head is the first row.
        let Some((at, compared)) =
            index.checked_sub(1).and_then(|at| Some((at, agreement.compared.get(at)?)))
        else {
            continue;
        };
        let asked = &compared.asked;
        if let Some(why) = compared.indeterminate() {
            out.push_str(&wrapped(&format!("indeterminate: {why}")));
            continue;
        }
        if let Some(couple) = compared.graphical.couple {
            let sense = if couple > 0.0 { "ccw" } else { "cw" };
            let size = significant(couple.abs() / units.torque.si, 7);
            out.push_str(&wrapped(&format!("a couple of {size} {} {sense}", units.torque.symbol)));
        }
        if let Some(fine) = &compared.graphical.fine {
            let bound = fine_bound(fine, asked);
            let digits = digits(fine, asked).join(", ");
            let _ = writeln!(out, "  {digits} {}, within {bound:.1e}", asked.unit.symbol);
        }
        if let Some(error) = by_hand.get(at) {
            out.push_str(&wrapped(&hand_words(asked, &compared.graphical.answer, error)));
        }
    }
    if let Some(sheet) = &solved.solution.construction.forces {
        for of in &sheet.stiffnesses {
            let (name, unit, si) = crate::report::stiffness(of, scene);
            let negative = if of.value < 0.0 { ": below zero, as no spring has it" } else { "" };
            let value = significant(of.value / si, 7);
            let _ = writeln!(out, "\nstiffness of {name}: {value} {unit}{negative}");
        }
    }
    let _ = writeln!(out, "\n{}", verdict(agreement));
    out
}

/// Words below a row, indented and not wider than a terminal.
fn wrapped(words: &str) -> String {
    let mut out = String::new();
    let mut line = String::new();
    for word in words.split(' ') {
        if !line.is_empty() && line.chars().count() + word.chars().count() + 5 > WIDEST {
            let _ = writeln!(out, "    {line}");
            line.clear();
        }
        line.push_str(if line.is_empty() { "" } else { " " });
        line.push_str(word);
    }
    let _ = writeln!(out, "    {line}");
    out
}

/// A row: name, value, direction or sense, the other solver's value, and how far apart they are in units of the sum of
/// the bounds. What the bound cannot tell from zero is zero, and points nowhere. Of what is indeterminate only the name.
fn cells(compared: &Compared, construction: &Construction, digits: usize) -> [String; 5] {
    let asked = &compared.asked;
    let name = named(asked);
    if compared.indeterminate().is_some() {
        return [name, String::new(), String::new(), String::new(), String::new()];
    }
    let zero = compared.graphical.zero;
    let tell = |answer: &Answer, zero: bool| value_and_direction(asked, answer, (construction, zero), digits);
    let (value, direction) = tell(&compared.graphical.answer, zero);
    let value = if matches!(compared.graphical.answer, Answer::AtInfinity { .. }) {
        value
    } else {
        format!("{value} {}", asked.unit.symbol).trim_end().to_owned()
    };
    let (other, _) = tell(&compared.analytic, zero && compared.analytic.may_be_zero());
    let off = compared.difference.map_or("not comparable".to_owned(), |difference| {
        if difference.ratio > 1.0 {
            significant(difference.ratio, 2)
        } else {
            format!("{:.2}", difference.ratio)
        }
    });
    [name, value, direction, other, off]
}

/// A value in its unit, and where it points or turns. What few digits are certain of is told with its bound.
fn value_and_direction(
    asked: &Asked,
    answer: &Answer,
    (construction, zero): (&Construction, bool),
    digits: usize,
) -> (String, String) {
    let certain = certain_digits(answer);
    let digits = digits.min(certain);
    let number = |x: f64| match answer {
        Answer::Scalar { bound, .. } | Answer::Vector { bound, .. } if certain < FEW => {
            within(x / asked.unit.si, bound / asked.unit.si)
        }
        _ => significant(x / asked.unit.si, digits),
    };
    let degrees = |[x, y]: [f64; 2]| {
        format!("{} deg", significant(libm::atan2(y, x).to_degrees(), if certain < FEW { 3 } else { 5 }))
    };
    match answer {
        _ if zero && is_place(&asked.quantity) => ("(0, 0)".to_owned(), String::new()),
        Answer::Vector { value, bound } if is_place(&asked.quantity) => {
            let [x, y] = construction.told_place(*value, *bound).map(number);
            (format!("({x}, {y})"), String::new())
        }
        _ if zero => ("0".to_owned(), String::new()),
        Answer::Vector { value, .. } if answer.may_be_zero() => {
            (number(libm::hypot(value[0], value[1])), String::new())
        }
        Answer::Vector { value, bound } => {
            // What is rounding turns no direction by 1e-15°; what a room leaves open does.
            let size = libm::hypot(value[0], value[1]);
            let sure = value.map(|c| if c.abs() <= *bound && c.abs() <= ROUNDING * size { 0.0 } else { c });
            (number(size), degrees(sure))
        }
        Answer::Scalar { value, .. } if answer.may_be_zero() => (number(*value), String::new()),
        Answer::Scalar { value, .. } if has_sense(&asked.quantity) => {
            (number(value.abs()), if *value > 0.0 { "ccw" } else { "cw" }.to_owned())
        }
        Answer::Scalar { value, .. } => (number(*value), String::new()),
        Answer::AtInfinity { direction, .. } => {
            ("at infinity".to_owned(), format!("{} deg", significant(half_turn(*direction), 5)))
        }
        Answer::Indeterminate(_) => (String::new(), String::new()),
    }
}

/// A number of which fewer digits are certain is told with its bound.
const FEW: usize = 4;
/// A component smaller than this part of its vector is rounding where its bound allows zero.
const ROUNDING: f64 = 1e-9;

/// A number with its bound, which is rounded up to two figures: 35.6 ± 6.9.
fn within(number: f64, bound: f64) -> String {
    if !(number.is_finite() && bound.is_finite()) || bound <= 0.0 {
        return significant(number, 1);
    }
    let place = 1.0 - libm::floor(libm::log10(bound));
    let unit = libm::pow(10.0, -place);
    let bound = libm::ceil(bound / unit) * unit;
    let number = if place < 0.0 { libm::round(number / unit) * unit } else { number };
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a decimal exponent")]
    let decimals = place.max(0.0) as usize;
    format!("{number:.decimals$} ± {bound:.decimals$}")
}

/// How many digits of a number its bound leaves certain, at least one.
fn certain_digits(answer: &Answer) -> usize {
    let (size, bound) = match answer {
        Answer::Scalar { value, bound } => (value.abs(), *bound),
        Answer::Vector { value: [x, y], bound } => (libm::hypot(*x, *y), *bound),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return usize::MAX,
    };
    (1..17).rev().find(|&digits| bound * libm::pow(10.0, digits as f64) <= size).unwrap_or(1)
}

/// Whether a quantity is a place, whose coordinates are told.
fn is_place(quantity: &Quantity) -> bool {
    quantity.nature() == Nature::Place
}

/// Whether a scalar turns, ccw or cw.
fn has_sense(quantity: &Quantity) -> bool {
    quantity.nature() == Nature::Rotation
}

/// The name of a quantity, with the method by which it is asked where that is not the polygon.
fn named(asked: &Asked) -> String {
    match asked.method {
        Method::Polygon => asked.name.clone(),
        method => format!("{} by {}", asked.name, method.name()),
    }
}

/// One line on the agreement of the two solvers.
pub(super) fn verdict(agreement: &Agreement) -> String {
    if let Some(refused) = &agreement.refused {
        return format!("the analytic solver refused: {refused}");
    }
    if let Some(elsewhere) = &agreement.elsewhere {
        return format!(
            "graphical and analytic DO NOT AGREE, they stand in different assemblies: {elsewhere}"
        );
    }
    if let Some(power) = agreement.power.filter(|power| !power.balances()) {
        return format!(
            "the powers DO NOT BALANCE: {} W are left, more than their bound of {} W",
            short(power.residual),
            short(power.bound)
        );
    }
    let worst = match agreement.worst_ratio() {
        ratio if ratio > 0.0 && ratio < 1e-3 => "less than 0.001".to_owned(),
        ratio => short(ratio),
    };
    let wrong = agreement.disagreements();
    if wrong.is_empty() {
        return format!("graphical and analytic agree: worst difference is {worst} of the bounds");
    }
    let mut said = format!("graphical and analytic DO NOT AGREE: worst difference is {worst} of the bounds");
    for disagreement in wrong {
        let _ = write!(said, "\n  {disagreement}");
    }
    said
}

fn object(
    file: &str,
    scene: &Scene,
    solved: &crate::solve::Solved,
    agreement: &Agreement,
    by_hand: &[HandError],
) -> Value {
    let mut quantities: Vec<Value> =
        agreement.compared.iter().map(|compared| quantity(compared, scene)).collect();
    for ((value, compared), error) in quantities.iter_mut().zip(&agreement.compared).zip(by_hand) {
        if let (Some(map), None) = (value.as_object_mut(), compared.indeterminate()) {
            map.insert("hand".to_owned(), hand_object(&compared.asked, error));
        }
    }
    let mut verdict_of = json!({ "worst_ratio": agreement.worst_ratio(), "ok": agreement.ok() });
    if let (false, Some(map)) = (agreement.ok(), verdict_of.as_object_mut()) {
        map.insert("why".to_owned(), json!(verdict(agreement)));
    }
    let mut object = json!({
        "scene": scene.title.in_language("en").unwrap_or(file),
        "degrees_of_freedom": solved.structure.mobility.freedoms,
        "mobility": solved.structure.mobility.to_string(),
        "quantities": quantities,
        "agreement": verdict_of,
    });
    let sheet = solved.solution.construction.forces.as_ref().filter(|sheet| !sheet.rubs.is_empty());
    if let (Some(sheet), Some(map)) = (sheet, object.as_object_mut()) {
        let rubs = sheet.rubs.iter().map(|touch| friction(&touch.rub, scene, sheet.passes));
        map.insert("friction".to_owned(), rubs.collect());
    }
    let sheet = solved.solution.construction.forces.as_ref().filter(|sheet| !sheet.stiffnesses.is_empty());
    if let (Some(sheet), Some(map)) = (sheet, object.as_object_mut()) {
        let told = sheet.stiffnesses.iter().map(|of| {
            let (name, unit, si) = crate::report::stiffness(of, scene);
            json!({ "spring": name, "stiffness": of.value / si, "unit": unit })
        });
        map.insert("stiffness".to_owned(), told.collect());
    }
    if let (Some(power), Some(map)) = (&agreement.power, object.as_object_mut()) {
        let unit = &scene.units.power;
        let watts = |x: f64| json!(x / unit.si);
        let told = json!({
            "unit": unit.symbol,
            "effort": watts(power.effort),
            "loads": watts(power.loads),
            "weights": watts(power.weights),
            "springs": watts(power.springs),
            "inertia": watts(power.inertia),
            "friction": watts(power.friction),
            "residual": watts(power.residual),
            "bound": watts(power.bound),
        });
        map.insert("power".to_owned(), told);
    }
    object
}

/// What rubs: where, in which sense it moves, by how much its force leans or misses the pin.
fn friction(rub: &Rub, scene: &Scene, passes: usize) -> Value {
    let m = &scene.mechanism;
    let number = |link: crate::mechanism::LinkId| m.link(link).number;
    let (at, between, sense) = match rub.pair {
        RubbingPair::Pin { pin, carrier, link } => {
            let sense = if rub.forward { "ccw" } else { "cw" };
            (m.point(pin).name.clone(), json!([number(carrier), number(link)]), sense)
        }
        RubbingPair::Slide(slide) => {
            let at = m.pin_of_slide(slide).map(|point| m.point(point).name.clone());
            let sense = if rub.forward { "forward" } else { "backward" };
            let links: Vec<u32> = m.rubbing_links(rub.pair).into_iter().map(number).collect();
            (at.unwrap_or_default(), json!(links), sense)
        }
    };
    let (key, value) = match rub.by {
        RubbedBy::Circle(radius) => ("circle", radius / scene.units.length.si),
        RubbedBy::Angle(angle) => ("angle_deg", angle.to_degrees()),
        RubbedBy::Drag(force) => ("drag", force / scene.units.force.si),
    };
    json!({ "at": at, "between": between, "sense": sense, key: value, "passes": passes })
}

/// How long a vector is on paper: at the scale that the scene states for its diagram, otherwise on the drawing board, whose
/// scales are powers of two. A force is a side of a polygon only at a stated scale: the board has the same force in several.
fn drawn_mm(compared: &Compared, sheet: &SheetOptions) -> Option<f64> {
    if let (Measure::Force, Answer::Vector { value, .. }) =
        (compared.asked.quantity.measure(), &compared.graphical.answer)
    {
        return sheet.force_scale.map(|scale| libm::hypot(value[0], value[1]) / scale);
    }
    let drawn = compared.graphical.drawn_mm?;
    let stated = match compared.asked.quantity.measure() {
        Measure::Velocity => sheet.velocity_scale,
        Measure::Acceleration => sheet.acceleration_scale,
        _ => None,
    };
    let size = match compared.graphical.answer {
        Answer::Scalar { value, .. } => value.abs(),
        Answer::Vector { value, .. } => libm::hypot(value[0], value[1]),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return Some(drawn),
    };
    Some(stated.map_or(drawn, |scale| size / scale))
}

fn quantity(compared: &Compared, scene: &Scene) -> Value {
    let (length, torque) = (scene.units.length.si, scene.units.torque.si);
    let asked = &compared.asked;
    let mut map = Map::new();
    map.insert("name".to_owned(), json!(asked.name));
    map.insert("unit".to_owned(), json!(asked.unit.symbol));
    if asked.method != Method::Polygon {
        map.insert("method".to_owned(), json!(asked.method.name()));
    }
    if let Some(why) = compared.indeterminate() {
        map.insert("indeterminate".to_owned(), json!(why.to_string()));
        return Value::Object(map);
    }
    insert_value(&mut map, asked, &compared.graphical.answer);
    if let Some(fine) = &compared.graphical.fine {
        let digits = digits(fine, asked);
        let digits = if digits.len() == 1 { json!(digits[0]) } else { json!(digits) };
        map.insert("digits".to_owned(), digits);
        map.insert("digits_bound".to_owned(), json!(fine_bound(fine, asked)));
    }
    let in_unit = |x: f64| json!(x / asked.unit.si);
    match &compared.analytic {
        Answer::Scalar { value, bound } => {
            map.insert("analytic".to_owned(), in_unit(*value));
            map.insert("analytic_bound".to_owned(), json!(bound_in_unit(*bound, *value, asked.unit.si)));
        }
        Answer::Vector { value, bound } => {
            map.insert("analytic".to_owned(), json!(value.map(|v| v / asked.unit.si)));
            let magnitude = libm::hypot(value[0], value[1]);
            map.insert("analytic_bound".to_owned(), json!(bound_in_unit(*bound, magnitude, asked.unit.si)));
        }
        Answer::AtInfinity { direction, .. } => {
            map.insert("analytic_direction_deg".to_owned(), json!(half_turn(*direction)));
        }
        Answer::Indeterminate(_) => {}
    }
    if let Some(difference) = compared.difference {
        let factor = if matches!(compared.analytic, Answer::AtInfinity { .. }) { 1.0 } else { asked.unit.si };
        map.insert("difference".to_owned(), json!(difference.value / factor));
    }
    if let Some(mm) = drawn_mm(compared, &scene.sheet) {
        map.insert("drawn_mm".to_owned(), json!(mm));
    }
    if let Some(place) = compared.graphical.through {
        map.insert("through".to_owned(), json!(place.map(|c| c / length)));
    }
    if let Some(couple) = compared.graphical.couple {
        // A pure couple has no force.
        map.insert("value".to_owned(), json!([0.0, 0.0]));
        map.insert("magnitude".to_owned(), json!(0.0));
        map.insert("couple".to_owned(), json!(couple / torque));
    }
    Value::Object(map)
}

/// `by hand within ±1.2 cm/s (0.7 %), half of them within 0.4, at worst ±2.5 cm/s`.
fn hand_words(asked: &Asked, answer: &Answer, error: &HandError) -> String {
    let si = asked.unit.si;
    let n = |x: f64| two_digits(x / si);
    let Some(spread) = error.spread else { return "by hand: cannot be drawn".to_owned() };
    let size = match answer {
        Answer::Scalar { value, .. } => value.abs(),
        Answer::Vector { value, .. } => libm::hypot(value[0], value[1]),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => 0.0,
    };
    let percent =
        if size > 0.0 { format!(" ({} %)", two_digits(100.0 * spread.most / size)) } else { String::new() };
    let flat = if error.flat { " (to first order: too flat to rely on)" } else { "" };
    let worst = format!("at worst ±{}{flat}", error.worst.map_or("?".to_owned(), n));
    let failed = if error.failed > 0 {
        format!("; {} of {DRAUGHTSMEN} do not close", error.failed)
    } else {
        String::new()
    };
    let unit = &asked.unit.symbol;
    format!(
        "by hand ±{} {unit}{percent}, half of them within {}, {worst}{failed}",
        n(spread.most),
        n(spread.median)
    )
}

/// The same for programs, in the unit of the answer.
fn hand_object(asked: &Asked, error: &HandError) -> Value {
    let in_unit = |x: f64| x / asked.unit.si;
    json!({
        "worst": error.worst.map(in_unit),
        "flat": error.flat,
        "median": error.spread.map(|s| in_unit(s.median)),
        "most": error.spread.map(|s| in_unit(s.most)),
        "largest": error.spread.map(|s| in_unit(s.largest)),
        "failed": error.failed,
        "draughtsmen": DRAUGHTSMEN,
    })
}

/// A fine value in its unit, with the digits that its bound leaves.
fn digits(fine: &Fine, asked: &Asked) -> Vec<String> {
    let bound = fine_bound(fine, asked);
    let si = crate::scene::si_of(&asked.unit);
    let in_unit = |v: &DoubleDouble| *v / si;
    let digits = |v: DoubleDouble| {
        // One digit beyond the first that the bound reaches.
        let clear = libm::log10(v.abs().hi() / bound);
        let most = 31.0;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "1 to 31")]
        let digits = if clear.is_nan() { most } else { (clear.ceil() + 1.0).clamp(1.0, most) } as usize;
        v.decimals(digits)
    };
    fine.value.iter().map(in_unit).map(digits).collect()
}

/// The bound of a fine value in its unit, with the rounding of the division.
fn fine_bound(fine: &Fine, asked: &Asked) -> f64 {
    let size = fine.value.iter().fold(0.0, |sum, v| libm::hypot(sum, v.hi())) / asked.unit.si;
    fine.bound / asked.unit.si * (1.0 + f64::EPSILON) + size * 4.0 * DoubleDouble::ROUNDOFF
}

/// A bound in the unit of the answer, with the roundings that this costs: the unit's own two and the
/// division.
fn bound_in_unit(bound: f64, value: f64, si: f64) -> f64 {
    bound / si + (value / si).abs() * 1.5 * f64::EPSILON
}

/// Direction of a centre at infinity, degrees in [0, 180).
fn half_turn(direction: [f64; 2]) -> f64 {
    libm::atan2(direction[1], direction[0]).to_degrees().rem_euclid(180.0)
}

fn insert_value(map: &mut Map<String, Value>, asked: &Asked, answer: &Answer) {
    let si = asked.unit.si;
    let bound_of = |bound, value| json!(bound_in_unit(bound, value, si));
    match answer {
        Answer::Scalar { value, bound } => {
            map.insert("value".to_owned(), json!(value / si));
            if has_sense(&asked.quantity) && !answer.may_be_zero() {
                let sense = if *value > 0.0 { "ccw" } else { "cw" };
                map.insert("sense".to_owned(), json!(sense));
            }
            map.insert("bound".to_owned(), bound_of(*bound, *value));
        }
        Answer::Vector { value, bound } => {
            let [x, y] = value.map(|v| v / si);
            let magnitude = libm::hypot(x, y);
            map.insert("value".to_owned(), json!([x, y]));
            map.insert("magnitude".to_owned(), json!(magnitude));
            if !answer.may_be_zero() {
                map.insert("direction_deg".to_owned(), json!(libm::atan2(y, x).to_degrees()));
            }
            map.insert("bound".to_owned(), bound_of(*bound, magnitude * si));
        }
        Answer::AtInfinity { direction, bound } => {
            map.insert("at_infinity".to_owned(), json!(true));
            map.insert("direction_deg".to_owned(), json!(half_turn(*direction)));
            map.insert("bound".to_owned(), json!(bound.to_degrees()));
        }
        Answer::Indeterminate(_) => {}
    }
}
