//! Answers as CSV: one row per quantity, or one row per point.

use super::answers::{
    Answers, FigurePoints, Item, directed, drawn, on_paper, order_of, quantity as asked_by, scalar, turned,
    vector,
};
use super::digits::{refuse_decimal_comma, with_plain_digits, with_plain_sense, with_plain_unit};
use crate::limits;
use crate::mechanism::quantity::{Asked, Order, Quantity};
use crate::scene::Scene;
use crate::scene::asked::Names;
use crate::scene::diagnostic::{Fault, Res};
use crate::scene::json::{Kind, Value};
use crate::scene::units::{Measure, Scale, Scales, Words, number};

const QUANTITY: [&str; 7] = ["quantity", "value", "x", "y", "unit", "sense", "direction"];
const POINT: [&str; 4] = ["figure", "point", "x", "y"];

/// No row has more fields than there are columns.
const MOST_FIELDS: usize = 16;

/// A row.
struct Row {
    /// Its fields and where each begins.
    fields: Vec<(String, usize)>,
    /// It does not end as a row does.
    broken: Option<Fault>,
}

pub(super) fn read(text: &str, scene: &Scene, mut answers: Answers) -> Res<Answers> {
    let scales = Scales::read(None, Some(&scene.units))?;
    let names = Names::new(&scene.mechanism, &scales);
    let mut columns: Option<Vec<String>> = None;
    // Spreadsheets end with rows of empty fields.
    let written = |row: &Row| row.broken.is_some() || row.fields.iter().any(|(text, _)| !text.is_empty());
    for Row { fields: row, broken } in rows(text)?.into_iter().filter(written) {
        let first = row.first().map_or(0, |(_, at)| *at);
        if let Some(header) = header(&row)? {
            columns = Some(header);
            continue;
        }
        // Whose answers these are, and to which variant of an exam.
        if let [(key, _), value @ ..] = &row[..]
            && matches!(key.to_lowercase().as_str(), "student" | "variant")
            && value.iter().skip(1).all(|(text, _)| text.is_empty())
        {
            let value = value.first().map_or("", |(text, _)| text.as_str());
            if key.eq_ignore_ascii_case("student") && !value.is_empty() {
                answers.student = Some(value.to_owned());
            }
            continue;
        }
        let Some(columns) = &columns else {
            let fault = Fault::new(first, "neither JSON nor a table with a known header");
            return Err(
                fault.mend("begin with the row `quantity,value,unit,sense,direction` or `figure,point,x,y`")
            );
        };
        answers.count(first)?;
        let field = |name: &str| {
            let index = columns.iter().position(|c| c == name)?;
            row.get(index).filter(|(text, _)| !text.is_empty())
        };
        let whole = || -> Res<()> {
            if let Some(broken) = broken {
                return Err(broken);
            }
            if row.len() > columns.len() {
                return Err(Fault::new(row[columns.len()].1, "more fields than the header has"));
            }
            let mut numbers = ["value", "x", "y", "direction"].into_iter().filter_map(field);
            numbers.try_for_each(|(text, at)| refuse_decimal_comma(text, *at))
        };
        let need =
            |name: &str| field(name).ok_or_else(|| Fault::new(first, format!("this row has no `{name}`")));
        if !columns.iter().any(|c| c == "quantity") {
            let read = whole().and_then(|()| point(&need));
            let name = [field("figure"), field("point")].map(|own| own.map_or("", |(text, _)| text));
            if let Some((order, point)) = answers.grasp(&name.join(":"), None, read) {
                figure_of(&mut answers, order).points.push(point);
            }
            continue;
        }
        let name = field("quantity").map_or("", |(text, _)| text.as_str());
        let asked = need("quantity").and_then(|(name, at)| asked_by(&names, name, *at, scene));
        let Some(asked) = answers.grasp(name, None, asked) else { continue };
        let of = asked.quantity;
        let item = whole().and_then(|()| quantity(asked, &need, &field, &scales));
        let item = answers.grasp(name, Some(of), item);
        answers.items.extend(item.flatten());
    }
    answers.void_what_is_written_twice();
    answers.take_plus_for_a_sense();
    Ok(answers)
}

/// The names of the columns, where the row is a header.
fn header(row: &[(String, usize)]) -> Res<Option<Vec<String>>> {
    let names: Vec<String> = row.iter().map(|(text, _)| text.to_lowercase()).collect();
    let known: &[&str] = match names.first().map(String::as_str) {
        Some("quantity") => &QUANTITY,
        Some("figure") => &POINT,
        _ => return Ok(None),
    };
    for (name, (_, at)) in names.iter().zip(row) {
        if !known.contains(&name.as_str()) {
            return Err(
                Fault::new(*at, format!("unknown column `{name}`")).known(name, known.iter().copied())
            );
        }
    }
    Ok(Some(names))
}

/// What a row says of a quantity; nothing where its box was left empty.
fn quantity<'r>(
    asked: Asked,
    need: &impl Fn(&str) -> Res<&'r (String, usize)>,
    field: &impl Fn(&str) -> Option<&'r (String, usize)>,
    scales: &Scales,
) -> Res<Option<Item>> {
    let (_, at) = need("quantity")?;
    if ["value", "x", "y"].iter().all(|column| field(column).is_none()) {
        return match field("sense").or_else(|| field("direction")) {
            Some((_, at)) => Err(Fault::new(*at, "this row has no `value`")),
            None => Ok(None),
        };
    }
    let unit = field("unit");
    if let (None, Some(x), Some(y)) = (field("value"), field("x"), field("y")) {
        let [x, y] = [x, y].map(|(text, at)| Value { at: *at, kind: Kind::Text(text.clone()) });
        let scale =
            unit.map(|(symbol, at)| Scale::parse(symbol, *at)?.must_be(asked.quantity.measure(), *at));
        let item = vector(asked, [&x, &y], scale.transpose()?, *at, scales)?;
        if let Some((_, at)) = field("sense").or_else(|| field("direction")) {
            return Err(Fault::new(*at, "two components have their direction already"));
        }
        return Ok(Some(item));
    }
    let (text, value_at) = need("value")?;
    if let Some((_, at)) = field("x").or_else(|| field("y")) {
        let fault = Fault::new(*at, "both a value and a component");
        return Err(fault.mend("give `value`, or `x` and `y`"));
    }
    let of_polygon = !matches!(asked.quantity, Quantity::Position(_) | Quantity::Centre(..));
    if let (Some((symbol, _)), Measure::Velocity | Measure::Acceleration, true) =
        (unit, asked.quantity.measure(), of_polygon)
        && symbol == "mm"
    {
        let mm = number(text, *value_at)?.value;
        return drawn(asked, mm, 0.0, *at).map(Some);
    }
    let unit = unit.map(|(symbol, at)| Scale::parse(symbol, *at)?.must_be(asked.quantity.measure(), *at));
    let value = Value { at: *value_at, kind: Kind::Text(text.clone()) };
    let mut item = scalar(asked, &value, unit.transpose()?, *at, scales)?;
    if let Some((sense, at)) = field("sense") {
        let sign = match sense.as_str() {
            "cw" => -1.0,
            "ccw" => 1.0,
            other => {
                return Err(Fault::new(*at, format!("`{other}` is no sense")).known(other, ["cw", "ccw"]));
            }
        };
        item.given = turned(&item, sign)?;
    }
    if let Some((direction, at)) = field("direction") {
        let value = Value { at: *at, kind: Kind::Text(direction.clone()) };
        item = directed(item, scales.given(&value, Measure::Angle)?.value)?;
    }
    Ok(Some(item))
}

/// A point: its figure, and its name, its coordinates and where they stand.
type Placed = (Order, (String, [f64; 2], usize));

/// The point of a row, by its figure.
fn point<'r>(need: &impl Fn(&str) -> Res<&'r (String, usize)>) -> Res<Placed> {
    let (figure, at) = need("figure")?;
    let order = order_of(figure).ok_or_else(|| {
        Fault::new(*at, format!("`{figure}` is no figure"))
            .known(figure, ["velocity", "acceleration", "skeleton"])
    })?;
    let coordinate = |name: &str| -> Res<f64> {
        let (text, at) = need(name)?;
        match Words::split(text) {
            Some(Words { digits, unit: "" | "mm", sense: None }) => Ok(number(digits, *at)?.value),
            _ => Err(Fault::new(*at, format!("`{text}` is no number of millimetres"))),
        }
    };
    let place = [coordinate("x")?, coordinate("y")?];
    let (name, at) = need("point")?;
    on_paper(place[0], *at)?;
    on_paper(place[1], *at)?;
    Ok((order, (name.clone(), place, *at)))
}

fn figure_of(answers: &mut Answers, order: Order) -> &mut FigurePoints {
    let index = answers.figures.iter().position(|f| f.order == order).unwrap_or_else(|| {
        answers.figures.push(FigurePoints { order, points: Vec::new(), shared: Vec::new() });
        answers.figures.len() - 1
    });
    &mut answers.figures[index]
}

/// The rows that are neither empty nor a comment; a comma within brackets or quotes parts nothing.
fn rows(text: &str) -> Res<Vec<Row>> {
    let mut rows = Vec::new();
    let mut start = 0;
    // Where semicolons part the fields, as spreadsheets of many countries write it, a comma is a decimal sign.
    let is_header = |line: &&str| {
        let line = line.trim_start_matches('\u{feff}').trim_start().to_lowercase();
        line.starts_with("quantity") || line.starts_with("figure")
    };
    let header = text.lines().find(is_header).unwrap_or_default();
    let parted = header.contains([';', '\t']) && !header.contains(',');
    for line in text.split_inclusive('\n') {
        let content = line.trim_end_matches(['\n', '\r']);
        if !content.trim().trim_start_matches('\u{feff}').is_empty() && !content.trim_start().starts_with('#')
        {
            if rows.len() >= limits::ROWS {
                let most = limits::grouped(limits::ROWS);
                return Err(Fault::new(start, format!("more than {most} rows")));
            }
            rows.push(fields(content, start, parted)?);
        }
        start += line.len();
    }
    Ok(rows)
}

fn fields(line: &str, start: usize, parted: bool) -> Res<Row> {
    let mut row: Vec<(String, usize)> = Vec::new();
    let (mut from, mut depth, mut quoted) = (0, 0_i32, false);
    let mut push = |from: usize, to: usize| {
        let raw = line[from..to].trim_start_matches('\u{feff}');
        let blanks = raw.len() - raw.trim_start().len();
        let text = raw.trim();
        let bare = text.strip_prefix('"').and_then(|t| t.strip_suffix('"'));
        let text = bare.map_or_else(|| text.to_owned(), |b| b.replace("\"\"", "\""));
        // The name of a person stays as it is.
        let named = row.first().is_some_and(|(key, _): &(String, usize)| key.eq_ignore_ascii_case("student"));
        let typed = |text: &str| with_plain_unit(&with_plain_sense(&with_plain_digits(text))).into_owned();
        let text = if named { text } else { typed(&text) };
        let text = if parted { with_point(&text) } else { text };
        row.push((text, start + from + blanks));
    };
    let mut parts = 0;
    for (at, sign) in line.char_indices() {
        match sign {
            '"' => quoted = !quoted,
            '(' if !quoted => depth += 1,
            ')' if !quoted => depth -= 1,
            ',' | ';' | '\t' if !quoted && depth <= 0 && (sign != ',' || !parted) => {
                parts += 1;
                // Nothing is kept of a line that is no row.
                if parts > MOST_FIELDS {
                    return Err(Fault::new(start + at, "more fields than any header has"));
                }
                push(from, at);
                from = at + 1;
            }
            _ => {}
        }
    }
    push(from, line.len());
    let broken = quoted.then(|| Fault::new(start + from, "a quotation mark is not closed"));
    Ok(Row { fields: row, broken })
}

/// A number with a decimal comma, with a point instead; anything else as it is.
fn with_point(text: &str) -> String {
    let number = |part: &str| !part.is_empty() && part.bytes().all(|b| b.is_ascii_digit());
    let bare = text.trim_start_matches(['+', '-']);
    let (digits, unit) = bare.split_once(' ').map_or((bare, ""), |(digits, unit)| (digits, unit));
    match digits.split_once(',') {
        Some((whole, decimals)) if number(whole) && number(decimals) && !unit.contains(',') => {
            text.replacen(',', ".", 1)
        }
        _ => text.to_owned(),
    }
}
