//! What exam variants may change: ranges of any number of the scene, and the scene with other numbers.

use super::diagnostic::{Fault, Res};
use super::json::{self, Entry, Fields, Kind, Value};
use super::units::Words;
use super::{Scene, keys};

/// Keys of the scene whose numbers may vary: what is given, not what is asked, published or drawn.
const GIVEN: [&str; 14] = [
    "fixed", "placed", "links", "slides", "rolls", "input", "inputs", "pins", "gravity", "masses", "loads",
    "springs", "spin", "cycle",
];
/// Numbers that name a link, by the key behind which they stand.
const NAMES_LINKS: [&str; 4] = ["link", "links", "block", "slide"];
/// The same where a single number stands behind the key, and what is counted.
const NAMES_ONE: [&str; 7] = ["on", "in", "of", "sleeve", "balls", "carrier", "number"];
/// No range has more steps.
const MOST_STEPS: i128 = 1_000_000;

/// A number of the scene that variants change.
#[derive(Debug, Clone, PartialEq)]
pub struct Varied {
    /// Where it stands, as diagnostics write it: `links.2.length`, `fixed.O4[0]`.
    pub path: String,
    /// What the scene itself has there, in the number's own unit.
    pub own: f64,
    /// What it may be.
    pub range: Range,
}

/// From a first to a last number in equal steps, exact in decimals; in the unit of the number that varies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Range {
    first: i128,
    step: i128,
    /// How many steps lie between the first and the last.
    steps: u32,
    /// Decimals of `first` and `step`.
    places: u32,
}

impl Range {
    /// How many numbers there are, at least two.
    #[must_use]
    pub fn count(&self) -> u64 {
        u64::from(self.steps) + 1
    }

    /// The number of this index, as text; the last one beyond it.
    #[must_use]
    pub fn number(&self, index: u64) -> String {
        let index = index.min(u64::from(self.steps));
        decimal(self.first + self.step * i128::from(index), self.places)
    }
}

/// Units of 10⁻ᵖˡᵃᶜᵉˢ as a decimal number without needless zeros.
fn decimal(units: i128, places: u32) -> String {
    let one = 10_i128.pow(places);
    let sign = if units < 0 { "-" } else { "" };
    let (whole, rest) = (units.abs() / one, units.abs() % one);
    if rest == 0 {
        return format!("{sign}{whole}");
    }
    let rest = format!("{rest:0width$}", width = places as usize);
    format!("{sign}{whole}.{}", rest.trim_end_matches('0'))
}

/// A decimal number as units of 10⁻ᵖˡᵃᶜᵉˢ; `None` where it has an exponent or more than fifteen digits.
fn parse_decimal(digits: &str) -> Option<(i128, u32)> {
    let (whole, rest) = digits.split_once('.').unwrap_or((digits, ""));
    let plain = |text: &str| text.bytes().all(|b| b.is_ascii_digit());
    if !plain(whole.trim_start_matches('-')) || !plain(rest) || whole.len() + rest.len() > 16 {
        return None;
    }
    Some((format!("{whole}{rest}").parse().ok()?, u32::try_from(rest.len()).ok()?))
}

/// Reads `vary`.
pub(super) fn read(scene: &Value<'_>, value: Option<&Value<'_>>) -> Res<Vec<Varied>> {
    let Some(value) = value else { return Ok(Vec::new()) };
    let expected = "ranges by the path of a number, such as {\"links.2.length\": {\"from\": 12, …}}";
    let given = numbers(scene);
    let mut varied: Vec<Varied> = Vec::new();
    for Entry { at, key, value } in value.object(expected)? {
        let Some((path, number)) = given.iter().find(|(path, _)| path == key) else {
            let paths: Vec<&str> = given.iter().map(|(path, _)| path.as_str()).collect();
            return Err(Fault::new(*at, format!("`{key}` is not a given number of this scene"))
                .known(key, paths.iter().copied()));
        };
        let digits = match &number.kind {
            Kind::Text(text) => Words::split(text).map_or("", |words| words.digits),
            Kind::Number(digits) => digits,
            _ => "",
        };
        let own = super::units::number(digits, number.at)?.value;
        varied.push(Varied { path: path.clone(), own, range: range(value)? });
    }
    Ok(varied)
}

fn range(value: &Value<'_>) -> Res<Range> {
    let fields = Fields::of(value, keys::RANGE, "a range: {\"from\": 12, \"to\": 18, \"step\": 0.5}")?;
    let read = |key: &str, why: &str| -> Res<((i128, u32), usize)> {
        let value = fields.need(key, why)?;
        let Kind::Number(digits) = value.kind else {
            return Err(value
                .unexpected("a bare number")
                .mend("a range counts in the unit of the number that varies"));
        };
        let number = parse_decimal(digits).ok_or_else(|| {
            Fault::new(value.at, format!("`{digits}` cannot be counted in steps"))
                .mend("write it in decimals, without an exponent and with at most fifteen digits")
        })?;
        Ok((number, value.at))
    };
    let (from, _) = read("from", "the first number of the range")?;
    let (to, at_to) = read("to", "the last number of the range")?;
    let (step, at_step) = read("step", "by how much neighbours differ")?;
    let places = from.1.max(to.1).max(step.1);
    let [first, last, step] = [from, to, step].map(|(units, p)| units * 10_i128.pow(places - p));
    if step <= 0 {
        return Err(Fault::new(at_step, "a step is greater than zero")
            .mend("`from` is the smaller number, `to` the larger one"));
    }
    if last <= first {
        return Err(Fault::new(at_to, "`to` must be greater than `from`")
            .mend("exchange them, or leave the number out of `vary`"));
    }
    let steps = (last - first) / step;
    if (last - first) % step != 0 {
        let nearest = if steps == 0 { last } else { first + steps * step };
        let mend = match steps {
            0 => format!("take a step of {} or less", decimal(last - first, places)),
            _ => format!("end at {} or at {}", decimal(nearest, places), decimal(nearest + step, places)),
        };
        return Err(Fault::new(at_to, "the range is no whole number of steps").mend(mend));
    }
    if steps > MOST_STEPS {
        return Err(
            Fault::new(at_step, format!("{steps} steps, more than {MOST_STEPS}")).mend("take a larger step")
        );
    }
    let steps = u32::try_from(steps).unwrap_or(u32::MAX);
    Ok(Range { first, step, steps, places })
}

/// Every given number of a scene, with its path, in the order of the file.
fn numbers<'v, 'a>(scene: &'v Value<'a>) -> Vec<(String, &'v Value<'a>)> {
    fn walk<'v, 'a>(path: &str, value: &'v Value<'a>, into: &mut Vec<(String, &'v Value<'a>)>) {
        match &value.kind {
            Kind::Object(entries) => {
                for Entry { key, value, .. } in entries {
                    // The links themselves stand by number, and `links` of a rolling pair names two.
                    let single = matches!(value.kind, Kind::Number(_) | Kind::Text(_));
                    let names =
                        NAMES_LINKS.contains(&key.as_str()) || single && NAMES_ONE.contains(&key.as_str());
                    if !names {
                        walk(&format!("{path}.{key}"), value, into);
                    }
                }
            }
            Kind::List(items) => {
                for (index, item) in items.iter().enumerate() {
                    walk(&format!("{path}[{index}]"), item, into);
                }
            }
            Kind::Number(_) => into.push((path.to_owned(), value)),
            Kind::Text(text) if Words::split(text).is_some() => into.push((path.to_owned(), value)),
            Kind::Text(_) | Kind::Bool(_) | Kind::Null => {}
        }
    }
    let mut found = Vec::new();
    if let Kind::Object(entries) = &scene.kind {
        for Entry { key, value, .. } in entries.iter().filter(|e| GIVEN.contains(&e.key.as_str())) {
            walk(key, value, &mut found);
        }
    }
    found
}

/// The text of a variant: the scene with other numbers for what it varies, and with places by which its
/// assembly is chosen. What holds for the scene alone (`vary`, published values, an expected refusal) is
/// left out, and the variant's name stands after the title.
///
/// `numbers` are in the order of [`Scene::vary`]; `near` has the names of points and their places in the
/// scene's unit of length. A text that cannot be read any more gives an empty one.
#[must_use]
pub fn variant(scene: &Scene, numbers: &[String], near: &[(&str, [String; 2])], name: &str) -> String {
    let Ok(document) = json::parse(&scene.source.text) else { return String::new() };
    let new = scene.vary.iter().zip(numbers);
    let replaced: Vec<(usize, &str)> = self::numbers(&document.root)
        .into_iter()
        .filter_map(|(path, value)| {
            let (_, number) = new.clone().find(|(varied, _)| varied.path == path)?;
            Some((value.at, number.as_str()))
        })
        .collect();
    let writer = Writer { replaced, name };
    let mut lines: Vec<String> = Vec::new();
    let Kind::Object(entries) = &document.root.kind else { return String::new() };
    let titled = entries.iter().any(|e| e.key == "title");
    if !titled {
        lines.push(format!("  \"title\": {}", quoted(name)));
    }
    for Entry { key, value, .. } in entries {
        match key.as_str() {
            "vary" | "published" | "errata" | "expect" | "near" => {}
            "title" => lines.push(format!("  \"title\": {}", writer.title(value))),
            _ => lines.push(format!("  {}: {}", quoted(key), writer.value(value))),
        }
    }
    if !near.is_empty() {
        let places = near.iter().map(|(point, [x, y])| format!("{}: [{x}, {y}]", quoted(point)));
        lines.push(format!("  \"near\": {{ {} }}", places.collect::<Vec<_>>().join(", ")));
    }
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

/// The scene without some of what it asks, by their names, and without their marks. A text that cannot be read any more
/// gives an empty one.
#[must_use]
pub fn asking_less(scene: &Scene, unasked: &[String]) -> String {
    let Ok(document) = json::parse(&scene.source.text) else { return String::new() };
    let Kind::Object(entries) = &document.root.kind else { return String::new() };
    let writer = Writer { replaced: Vec::new(), name: "" };
    let kept = |name: &str| !unasked.iter().any(|unasked| unasked == name);
    let stays = |item: &Value<'_>| match &item.kind {
        Kind::Text(name) => kept(name),
        Kind::Object(entries) => entries.iter().all(|entry| match &entry.value.kind {
            Kind::Text(name) => entry.key != "name" || kept(name),
            _ => true,
        }),
        _ => true,
    };
    let find = |items: Vec<String>| format!("  \"find\": [{}]", items.join(", "));
    let mut lines: Vec<String> = Vec::new();
    for Entry { key, value, .. } in entries {
        let line = match (key.as_str(), &value.kind) {
            ("find", Kind::List(items)) => {
                find(items.iter().filter(|item| stays(item)).map(|item| writer.value(item)).collect())
            }
            ("sheet", Kind::Object(keys)) => {
                let keys = keys.iter().map(|entry| {
                    let value = match (entry.key.as_str(), &entry.value.kind) {
                        ("marks", Kind::Object(marks)) => {
                            let kept = marks.iter().filter(|mark| kept(&mark.key));
                            let kept = kept
                                .map(|mark| format!("{}: {}", quoted(&mark.key), writer.value(&mark.value)));
                            format!("{{ {} }}", kept.collect::<Vec<_>>().join(", "))
                        }
                        _ => writer.value(&entry.value),
                    };
                    format!("{}: {value}", quoted(&entry.key))
                });
                format!("  \"sheet\": {{ {} }}", keys.collect::<Vec<_>>().join(", "))
            }
            _ => format!("  {}: {}", quoted(key), writer.value(value)),
        };
        lines.push(line);
    }
    if !scene.source.asks() {
        let names = scene.mechanism.asked.iter().map(|asked| asked.name.as_str());
        lines.push(find(names.filter(|name| kept(name)).map(quoted).collect()));
    }
    format!("{{\n{}\n}}\n", lines.join(",\n"))
}

fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// Writes values as they were read, but for the numbers that vary.
struct Writer<'a> {
    /// Where the old number stands, and the new one.
    replaced: Vec<(usize, &'a str)>,
    name: &'a str,
}

impl Writer<'_> {
    fn value(&self, value: &Value<'_>) -> String {
        let new = self.replaced.iter().find(|(at, _)| *at == value.at).map(|(_, number)| *number);
        match &value.kind {
            Kind::Null => "null".to_owned(),
            Kind::Bool(value) => value.to_string(),
            Kind::Number(digits) => new.unwrap_or(digits).to_owned(),
            Kind::Text(text) => match (new, Words::split(text)) {
                (Some(new), Some(words)) => {
                    quoted(&format!("{new}{}", &text.trim_start()[words.digits.len()..]))
                }
                _ => quoted(text),
            },
            Kind::List(items) => {
                format!("[{}]", items.iter().map(|v| self.value(v)).collect::<Vec<_>>().join(", "))
            }
            Kind::Object(entries) => self.object(entries, |value| self.value(value)),
        }
    }

    fn object(&self, entries: &[Entry<'_>], write: impl Fn(&Value<'_>) -> String) -> String {
        let entries = entries.iter().map(|e| format!("{}: {}", quoted(&e.key), write(&e.value)));
        format!("{{ {} }}", entries.collect::<Vec<_>>().join(", "))
    }

    fn title(&self, value: &Value<'_>) -> String {
        match &value.kind {
            Kind::Text(text) => quoted(&format!("{text} · {}", self.name)),
            Kind::Object(entries) => self.object(entries, |value| self.title(value)),
            _ => self.value(value),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ranged(text: &str) -> Result<Range, String> {
        let root = json::parse(text).unwrap().root;
        range(&root).map_err(|fault| fault.locate("f", text, Some(&root)).to_string())
    }

    #[test]
    fn ranges_count_in_decimals() {
        let range = ranged(r#"{"from": -0.3, "to": 0.15, "step": 0.15}"#).unwrap();
        let numbers: Vec<String> = (0..range.count()).map(|i| range.number(i)).collect();
        assert_eq!(numbers, ["-0.3", "-0.15", "0", "0.15"]);
        // A double would say 0.30000000000000004.
        let range = ranged(r#"{"from": 0.1, "to": 0.5, "step": 0.1}"#).unwrap();
        assert_eq!((range.number(2), range.count()), ("0.3".to_owned(), 5));
        let range = ranged(r#"{"from": 100, "to": 300, "step": 50}"#).unwrap();
        assert_eq!((range.number(1), range.number(9)), ("150".to_owned(), "300".to_owned()));
    }

    #[test]
    fn ranges_that_cannot_be_counted() {
        for (text, complaint) in [
            (r#"{"from": 1, "to": 2}"#, "f:1:1: `step` is missing: by how much neighbours differ"),
            (
                r#"{"from": 1, "to": 2, "step": 0.3}"#,
                "f:1:19: to: the range is no whole number of steps; help: end at 1.9 or at 2.2",
            ),
            (
                r#"{"from": 1, "to": 2, "step": 3}"#,
                "f:1:19: to: the range is no whole number of steps; help: take a step of 1 or less",
            ),
            (
                r#"{"from": 2, "to": 1, "step": 1}"#,
                "f:1:19: to: `to` must be greater than `from`; help: exchange them, or leave the number out of `vary`",
            ),
            (
                r#"{"from": 1, "to": 2, "step": -1}"#,
                "f:1:30: step: a step is greater than zero; help: `from` is the smaller number, `to` the larger one",
            ),
            (
                r#"{"from": 1, "to": "2 cm", "step": 1}"#,
                "f:1:19: to: expected a bare number, found text; help: a range counts in the unit of the number that varies",
            ),
            (
                r#"{"from": 1e3, "to": 2000, "step": 1}"#,
                "f:1:10: from: `1e3` cannot be counted in steps; help: write it in decimals, without an exponent and with at most fifteen digits",
            ),
            (
                r#"{"from": 0, "to": 2, "step": 0.0000001}"#,
                "f:1:30: step: 20000000 steps, more than 1000000; help: take a larger step",
            ),
            (
                r#"{"from": 0, "to": 2, "steps": 1}"#,
                "f:1:22: steps: unknown key `steps`; help: did you mean `step`?",
            ),
        ] {
            assert_eq!(ranged(text).unwrap_err(), complaint);
        }
    }
}
