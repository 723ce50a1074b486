//! What a figure says, compared vector by vector, point by point, label by label.
//!
//! Read from the JSON of [`render::json`](crate::render::json). Things are found again by what they are (the
//! quantity of a vector and the names of its ends, the text of a label), never by where they stand, so that a
//! new layout is told as what it is.

mod digest;

use std::collections::{BTreeMap, HashMap, VecDeque};
use std::hash::Hash;

use serde::Deserialize;
use serde_json::Value;

use super::{Change, Weight};
use crate::render::json::VERSION;
use crate::report::short;

/// Half a unit of the last decimal that the ink of a quantity is written with, millimetres.
const ROUNDING: f64 = 0.5e-6;
/// A length between two written places, or a vector between two written ends, is known to this, millimetres;
/// what differs by more than twice of it was drawn differently.
const SPAN: f64 = 2.0 * std::f64::consts::SQRT_2 * ROUNDING;
/// Places that differ by less look alike, millimetres: the last decimal of ink that only has to look right.
const SEEN: f64 = 1e-3;
/// So many names stand in a list of things that moved.
const NAMED: usize = 6;

type Place = [f64; 2];

/// A figure, as its JSON has it.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Meaning {
    format: String,
    version: u32,
    #[serde(default)]
    language: String,
    #[serde(default)]
    title: String,
    #[serde(default)]
    description: String,
    pages: Vec<Page>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Page {
    width_mm: f64,
    height_mm: f64,
    panels: Vec<Panel>,
    texts: Vec<Label>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Panel {
    #[serde(default)]
    kind: String,
    #[serde(default)]
    title: String,
    #[serde(default)]
    scale: Scale,
    vectors: Vec<Vector>,
    points: Vec<Point>,
    lines: Vec<Line>,
    labels: Vec<Label>,
    parts: Vec<Part>,
}

#[derive(Debug, Clone, PartialEq, Default, Deserialize)]
struct Scale {
    per_mm: Option<f64>,
    unit: Option<String>,
    si_per_mm: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Vector {
    quantity: Option<String>,
    kind: String,
    tail: End,
    head: End,
    value: Option<f64>,
    si: Option<f64>,
    step: Option<f64>,
    #[serde(default)]
    as_point: bool,
    claim: Option<BTreeMap<String, String>>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct End {
    label: Option<String>,
    at_mm: Place,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Point {
    name: String,
    kind: String,
    at_mm: Place,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Line {
    from_mm: Place,
    to_mm: Place,
    step: Option<f64>,
    claim: Option<BTreeMap<String, String>>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Label {
    #[serde(default, rename = "in")]
    inside: String,
    text: String,
    #[serde(default)]
    class: String,
    at_mm: Option<Place>,
    size_mm: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
struct Part {
    class: Vec<String>,
    #[serde(default)]
    data: BTreeMap<String, String>,
    ink: Vec<Value>,
}

impl Meaning {
    /// Reads the JSON of a figure.
    ///
    /// # Errors
    /// One clause, where the text is not the JSON of a figure, or is of another version of its schema.
    pub fn read(text: &str) -> Result<Self, String> {
        let read: Self = serde_json::from_str(text).map_err(|error| error.to_string())?;
        if read.format != "linkgram-figure" {
            return Err(format!("`format` is \"{}\", not \"linkgram-figure\"", read.format));
        }
        if read.version != VERSION {
            return Err(format!(
                "a figure of version {}; this program writes version {VERSION}",
                read.version
            ));
        }
        Ok(read)
    }

    /// What differs in a later drawing, the weightiest first.
    #[must_use]
    pub fn changes(&self, actual: &Self) -> Vec<Change> {
        let mut comparison = Comparison::default();
        comparison.figures(self, actual);
        let mut changes = comparison.changes;
        changes.extend(comparison.moves.into_iter().map(Moves::told));
        changes.sort_by_key(|change| std::cmp::Reverse((change.weight, change.size)));
        changes
    }

    fn panels(&self) -> impl Iterator<Item = &Panel> {
        self.pages.iter().flat_map(|page| &page.panels)
    }
}

#[derive(Default)]
struct Comparison {
    changes: Vec<Change>,
    moves: Vec<Moves>,
}

/// Things of one sort in one panel that only stand elsewhere.
struct Moves {
    what: String,
    names: Vec<String>,
    farthest: f64,
}

impl Moves {
    fn told(self) -> Change {
        let Self { what, names, farthest } = self;
        let shown = names.iter().take(NAMED).map(String::as_str).collect::<Vec<_>>().join(", ");
        let more = if names.len() > NAMED { ", …" } else { "" };
        let much = if names.len() == 1 { "by" } else { "by up to" };
        Change::new(Weight::Cosmetic, format!("{what} moved {much} {} mm: {shown}{more}", mm(farthest)))
    }
}

/// Both of a pair, or what is only in one figure.
enum Met<'a, T> {
    Both(&'a T, &'a T),
    Gone(&'a T),
    New(&'a T),
}

/// Finds things again by their key; several of one key in their order.
fn meet<'a, T, K: Eq + Hash>(
    expected: impl IntoIterator<Item = &'a T>,
    actual: impl IntoIterator<Item = &'a T>,
    key: impl Fn(&'a T) -> K,
) -> Vec<Met<'a, T>> {
    let actual: Vec<&T> = actual.into_iter().collect();
    let mut waiting: HashMap<K, VecDeque<usize>> = HashMap::new();
    for (index, one) in actual.iter().enumerate() {
        waiting.entry(key(one)).or_default().push_back(index);
    }
    let mut new = vec![true; actual.len()];
    let mut met = Vec::new();
    for one in expected {
        match waiting.get_mut(&key(one)).and_then(VecDeque::pop_front) {
            Some(index) => {
                new[index] = false;
                met.push(Met::Both(one, actual[index]));
            }
            None => met.push(Met::Gone(one)),
        }
    }
    met.extend(actual.into_iter().zip(new).filter(|(_, new)| *new).map(|(one, _)| Met::New(one)));
    met
}

impl Comparison {
    fn tell(&mut self, weight: Weight, what: impl Into<String>) {
        self.changes.push(Change::new(weight, what));
    }

    fn figures(&mut self, expected: &Meaning, actual: &Meaning) {
        for (what, old, new) in [
            ("language", &expected.language, &actual.language),
            ("title", &expected.title, &actual.title),
            ("description", &expected.description, &actual.description),
        ] {
            self.wording(what, old, new);
        }
        let (old, new) = (expected.pages.len(), actual.pages.len());
        if old != new {
            self.tell(Weight::Cosmetic, format!("{new} page{}, was {old}", if new == 1 { "" } else { "s" }));
        }
        for (number, (old, new)) in expected.pages.iter().zip(&actual.pages).enumerate() {
            let size = |page: &Page| format!("{} × {} mm", mm(page.width_mm), mm(page.height_mm));
            if size(old) != size(new) {
                let what = format!("page {} is {}, was {}", number + 1, size(new), size(old));
                self.tell(Weight::Cosmetic, what);
            }
        }
        let mut seen: HashMap<&str, usize> = HashMap::new();
        for met in meet(expected.panels(), actual.panels(), |panel| panel.kind.as_str()) {
            let (Met::Both(panel, _) | Met::Gone(panel) | Met::New(panel)) = met;
            let nth = seen.entry(&panel.kind).or_default();
            *nth += 1;
            let name = if *nth > 1 { format!("{} ({nth})", panel.name()) } else { panel.name().to_owned() };
            match met {
                Met::Both(old, new) => self.panels(&name, old, new),
                Met::Gone(_) => self.tell(Weight::Content, format!("{name}: the whole panel is gone")),
                Met::New(_) => self.tell(Weight::Content, format!("{name}: a new panel")),
            }
        }
        let texts =
            |figure: &'_ Meaning| figure.pages.iter().flat_map(|p| p.texts.clone()).collect::<Vec<_>>();
        self.labels("text", &texts(expected), &texts(actual), [0.0, 0.0]);
    }

    /// A text that both figures have.
    fn wording(&mut self, what: &str, old: &str, new: &str) {
        if old != new {
            let weight =
                if without_numbers(old) == without_numbers(new) { Weight::Number } else { Weight::Content };
            self.tell(weight, format!("{what}: “{old}” became “{new}”"));
        }
    }

    fn panels(&mut self, name: &str, old: &Panel, new: &Panel) {
        self.wording(&format!("{name}, title"), &old.title, &new.title);
        if old.scale != new.scale {
            let told = |scale: &Scale| {
                let number = scale.per_mm.map_or("none".to_owned(), short);
                format!("{number} {}", scale.unit.as_deref().unwrap_or_default()).trim().to_owned()
            };
            self.tell(
                Weight::Number,
                format!("{name}, scale: {} became {}", told(&old.scale), told(&new.scale)),
            );
        }
        let shift = shift(old, new);
        if length(shift) > SEEN {
            let [x, y] = shift.map(mm);
            self.tell(Weight::Cosmetic, format!("{name}: the drawing moved by ({x}, {y}) mm"));
        }
        self.vectors(name, old, new, shift);
        self.points(name, old, new, shift);
        self.lines(name, old, new, shift);
        self.labels(&format!("{name}: label"), &old.labels, &new.labels, shift);
        self.parts(name, old, new);
    }

    fn vectors(&mut self, panel: &str, old: &Panel, new: &Panel, shift: Place) {
        let mut moves = Moves::of(format!("{panel}: vectors"));
        let key =
            |v: &Vector| (v.quantity.clone(), v.kind.clone(), v.tail.label.clone(), v.head.label.clone());
        for met in meet(&old.vectors, &new.vectors, key) {
            match met {
                Met::Gone(v) => {
                    self.tell(Weight::Content, format!("{panel}: the vector {} is gone", v.name()))
                }
                Met::New(v) => self.tell(Weight::Content, format!("{panel}: a new vector {}", v.name())),
                Met::Both(a, b) => {
                    let name = format!("{panel}, {}", b.name());
                    self.vector(&name, (old, a), (new, b));
                    let by = length(minus(minus(b.tail.at_mm, a.tail.at_mm), shift));
                    moves.add(b.name(), by);
                }
            }
        }
        self.moves.extend(moves.some());
    }

    fn vector(
        &mut self,
        name: &str,
        (old_panel, old): (&Panel, &Vector),
        (new_panel, new): (&Panel, &Vector),
    ) {
        if old.claim != new.claim {
            let what =
                format!("{name}: claimed {}, was {}", claim(new.claim.as_ref()), claim(old.claim.as_ref()));
            self.tell(Weight::Content, what);
        }
        if old.step != new.step {
            self.tell(Weight::Content, format!("{name}: drawn in another step"));
        }
        let scale = |panel: &Panel| panel.scale.si_per_mm.filter(|s| s.is_normal());
        let (per_old, per_new) = (scale(old_panel), scale(new_panel));
        // What the ink cannot show is a matter of the last digits.
        let ink = |mm: f64| per_old.zip(per_new).map_or(0.0, |(a, b)| mm * a.abs().max(b.abs()));
        let numbers = match (old.si.zip(new.si), old.value.zip(new.value)) {
            (Some((a, b)), _) | (None, Some((a, b))) => Some((a, b)),
            (None, None) => None,
        };
        let mut number_told = false;
        match numbers {
            Some((a, b)) if (a - b).abs() > ink(2.0 * ROUNDING) => {
                let told = |v: &Vector| v.value.map_or("nothing".to_owned(), short);
                let (unit, percent) = (new_panel.unit(), percent(a, b));
                let what = format!("{name}: {} became {}{unit}{percent}", told(old), told(new));
                self.changes.push(Change::new(Weight::Number, what).sized(a, b));
                number_told = true;
            }
            Some((a, b)) if a != b => {
                self.tell(Weight::Cosmetic, format!("{name}: the last digits of its value changed"));
            }
            None if old.value.is_some() || new.value.is_some() => {
                let told = |v: &Vector| v.value.map_or("no value".to_owned(), short);
                self.tell(Weight::Number, format!("{name}: {} became {}", told(old), told(new)));
            }
            _ => {}
        }
        if old.as_point != new.as_point {
            let now = if new.as_point { "a point" } else { "an arrow" };
            self.tell(Weight::Cosmetic, format!("{name}: drawn as {now} now"));
            return;
        }
        // What was drawn, whatever is written: the vector from the ends of its ink, at its scale.
        let drawn = |v: &Vector, per: Option<f64>| {
            minus(v.head.at_mm, v.tail.at_mm).map(|mm| mm * per.unwrap_or(1.0))
        };
        let (a, b) = (drawn(old, per_old), drawn(new, per_new));
        let room = if per_old.zip(per_new).is_some() { ink(2.0 * SPAN) } else { 2.0 * SPAN };
        if length(minus(a, b)) > room {
            let (long_a, long_b) = (length(a), length(b));
            let turned = turn(a, b);
            if (long_a - long_b).abs() > room && !number_told {
                let what = format!("{name}: the ink is longer or shorter{}", percent(long_a, long_b));
                self.changes.push(Change::new(Weight::Number, what).sized(long_a, long_b));
            }
            if libm::sin(turned).abs() * long_a.min(long_b) > room || libm::cos(turned) < 0.0 {
                // On the page y runs down; turns are told as the field counts them.
                let what = format!("{name}: turned by {}°", short(-turned.to_degrees()));
                // As large as the way of its head.
                let by = 2.0 * libm::sin(turned.abs() / 2.0);
                self.changes.push(Change::new(Weight::Number, what).sized(1.0, 1.0 - by));
            }
        }
    }

    fn points(&mut self, panel: &str, old: &Panel, new: &Panel, shift: Place) {
        let Some((origin_old, origin_new)) = origins(old, new) else {
            return self.strange_points(panel, old, new);
        };
        let scales =
            old.scale.si_per_mm.zip(new.scale.si_per_mm).filter(|(a, b)| a.is_normal() && b.is_normal());
        let mut moves = Moves::of(format!("{panel}: points"));
        for met in meet(&old.points, &new.points, |p| (p.kind.as_str(), p.name.as_str())) {
            let Met::Both(a, b) = met else { continue };
            let Some((per_old, per_new)) = scales else {
                moves.add(b.name.clone(), length(minus(minus(b.at_mm, a.at_mm), shift)));
                continue;
            };
            let from_old = minus(a.at_mm, origin_old.at_mm).map(|mm| mm * per_old);
            let from_new = minus(b.at_mm, origin_new.at_mm).map(|mm| mm * per_new);
            let by = length(minus(from_new, from_old));
            if by > 2.0 * SPAN * per_old.abs().max(per_new.abs()) {
                let (name, origin, by) = (&b.name, &origin_new.name, mm(by / per_new.abs()));
                let what = format!("{panel}: point {name} stands {by} mm elsewhere, seen from {origin}");
                self.tell(Weight::Number, what);
            }
        }
        self.moves.extend(moves.some());
        self.strange_points(panel, old, new);
    }

    fn strange_points(&mut self, panel: &str, old: &Panel, new: &Panel) {
        for met in meet(&old.points, &new.points, |p| (p.kind.as_str(), p.name.as_str())) {
            match met {
                Met::Both(..) => {}
                Met::Gone(p) => self.tell(Weight::Content, format!("{panel}: point {} is gone", p.name)),
                Met::New(p) => self.tell(Weight::Content, format!("{panel}: a new point {}", p.name)),
            }
        }
    }

    fn lines(&mut self, panel: &str, old: &Panel, new: &Panel, shift: Place) {
        let mut moves = Moves::of(format!("{panel}: construction lines"));
        let key = |line: &Line| (line.claim.clone(), line.step.map(f64::to_bits));
        for met in meet(&old.lines, &new.lines, key) {
            match met {
                Met::Gone(l) => {
                    self.tell(Weight::Content, format!("{panel}: the construction line {} is gone", l.name()))
                }
                Met::New(l) => {
                    self.tell(Weight::Content, format!("{panel}: a new construction line {}", l.name()))
                }
                Met::Both(a, b) => {
                    let (along_a, along_b) = (minus(a.to_mm, a.from_mm), minus(b.to_mm, b.from_mm));
                    let turned = turn(along_a, along_b);
                    let shorter = length(along_a).min(length(along_b));
                    if libm::sin(turned).abs() * shorter > 2.0 * SPAN {
                        let (name, by) = (b.name(), short(-turned.to_degrees()));
                        let what = format!("{panel}: the construction line {name} turned by {by}°");
                        self.tell(Weight::Number, what);
                    }
                    let ends = [(a.from_mm, b.from_mm), (a.to_mm, b.to_mm)];
                    let by = ends.map(|(a, b)| length(minus(minus(b, a), shift)));
                    moves.add(b.name(), by[0].max(by[1]));
                }
            }
        }
        self.moves.extend(moves.some());
    }

    fn labels(&mut self, what: &str, old: &[Label], new: &[Label], shift: Place) {
        let mut moves = Moves::of(format!("{what}s"));
        let mut resized = Vec::new();
        let (mut gone, mut added) = (Vec::new(), Vec::new());
        let key = |l: &Label| (l.inside.clone(), l.class.clone(), l.text.clone());
        for met in meet(old, new, key) {
            match met {
                Met::Gone(label) => gone.push(label.clone()),
                Met::New(label) => added.push(label.clone()),
                Met::Both(a, b) => {
                    if let Some((from, to)) = a.at_mm.zip(b.at_mm) {
                        moves.add(format!("“{}”", b.text), length(minus(minus(to, from), shift)));
                    }
                    if a.size_mm != b.size_mm {
                        resized.push(format!("“{}”", b.text));
                    }
                }
            }
        }
        self.moves.extend(moves.some());
        if !resized.is_empty() {
            let (shown, more) = (resized[..resized.len().min(NAMED)].join(", "), resized.len() > NAMED);
            let more = if more { ", …" } else { "" };
            self.tell(Weight::Cosmetic, format!("{what}s in another size: {shown}{more}"));
        }
        // What is the same but for its numbers became the other; what is left came or went.
        for met in meet(&gone, &added, |l| (l.inside.clone(), l.class.clone(), without_numbers(&l.text))) {
            match met {
                Met::Both(a, b) => {
                    self.tell(Weight::Number, format!("{what} “{}” became “{}”", a.text, b.text));
                }
                Met::Gone(label) => self.tell(Weight::Content, format!("{what} “{}” is gone", label.text)),
                Met::New(label) => self.tell(Weight::Content, format!("{what} “{}” is new", label.text)),
            }
        }
    }

    /// Everything else: symbols, and what depends on them as data.
    fn parts(&mut self, panel: &str, old: &Panel, new: &Panel) {
        let key = |part: &Part| {
            let mut data = part.data.clone();
            data.remove("value");
            (part.class.clone(), data)
        };
        let mut redrawn = 0;
        for met in meet(&old.parts, &new.parts, key) {
            match met {
                Met::Gone(p) => self.tell(Weight::Content, format!("{panel}: {} is gone", p.name())),
                Met::New(p) => self.tell(Weight::Content, format!("{panel}: {} is new", p.name())),
                Met::Both(a, b) => {
                    if let (Some(from), Some(to)) = (a.data.get("value"), b.data.get("value"))
                        && from != to
                    {
                        self.value_of_part(&format!("{panel}, {}", b.name()), from, to, b.data.get("unit"));
                    }
                    redrawn += usize::from(a.ink != b.ink);
                }
            }
        }
        if redrawn > 0 {
            let s = if redrawn == 1 { "" } else { "s" };
            self.tell(Weight::Cosmetic, format!("{panel}: {redrawn} symbol{s} drawn otherwise"));
        }
    }

    fn value_of_part(&mut self, name: &str, from: &str, to: &str, unit: Option<&String>) {
        let unit = unit.map_or(String::new(), |unit| format!(" {unit}"));
        match from.parse::<f64>().ok().zip(to.parse::<f64>().ok()) {
            // As many digits as the ink of a vector of 100 mm has.
            Some((a, b)) if (a - b).abs() <= a.abs().max(b.abs()) * ROUNDING / 50.0 => {
                self.tell(Weight::Cosmetic, format!("{name}: the last digits of its value changed"));
            }
            Some((a, b)) => {
                let (old, new, percent) = (short(a), short(b), percent(a, b));
                self.tell(Weight::Number, format!("{name}: {old} became {new}{unit}{percent}"));
            }
            None => self.tell(Weight::Content, format!("{name}: {from} became {to}{unit}")),
        }
    }
}

impl Moves {
    fn of(what: String) -> Self {
        Self { what, names: Vec::new(), farthest: 0.0 }
    }

    fn add(&mut self, name: String, by: f64) {
        if by > SEEN {
            self.names.push(name);
            self.farthest = self.farthest.max(by);
        }
    }

    fn some(self) -> Option<Self> {
        (!self.names.is_empty()).then_some(self)
    }
}

impl Panel {
    fn name(&self) -> &str {
        if self.kind.is_empty() { "panel" } else { &self.kind }
    }

    /// The unit of its vectors, after a blank.
    fn unit(&self) -> String {
        let unit = self.scale.unit.as_deref().unwrap_or_default();
        let unit = unit.strip_suffix(" per mm").unwrap_or(unit);
        if unit.is_empty() { String::new() } else { format!(" {unit}") }
    }
}

impl Vector {
    fn name(&self) -> String {
        let end = |end: &End| end.label.clone().unwrap_or_else(|| "?".to_owned());
        let ends = format!("{}→{}", end(&self.tail), end(&self.head));
        // A force of a polygon runs between points without names.
        if let (None, None, Some(quantity)) = (&self.tail.label, &self.head.label, &self.quantity) {
            return quantity.clone();
        }
        self.quantity.as_ref().map_or(ends.clone(), |quantity| format!("{quantity} {ends}"))
    }
}

impl Line {
    fn name(&self) -> String {
        let step = self.step.map_or(String::new(), |step| format!(" of step {}", short(step)));
        format!("{}{step}", claim(self.claim.as_ref()))
    }
}

impl Part {
    fn name(&self) -> String {
        let class = self.class.last().map_or("symbol", String::as_str);
        let of = ["quantity", "point", "link", "guide"].iter().find_map(|key| self.data.get(*key));
        of.map_or(class.to_owned(), |of| format!("{class} {of}"))
    }
}

/// The direction that is claimed: `∥ A B`.
fn claim(claim: Option<&BTreeMap<String, String>>) -> String {
    let told = |(kind, of): (&String, &String)| match kind.as_str() {
        "parallel" => format!("∥ {of}"),
        "perpendicular" => format!("⊥ {of}"),
        other => format!("{other} {of}"),
    };
    claim.and_then(|claim| claim.iter().next().map(told)).unwrap_or_else(|| "no direction".to_owned())
}

/// The point that both panels are seen from: the pole, or the first one that both have.
fn origins<'a>(old: &'a Panel, new: &'a Panel) -> Option<(&'a Point, &'a Point)> {
    let pairs = || {
        meet(&old.points, &new.points, |p| (p.kind.as_str(), p.name.as_str())).into_iter().filter_map(|met| {
            match met {
                Met::Both(a, b) => Some((a, b)),
                _ => None,
            }
        })
    };
    pairs().find(|(a, _)| a.kind == "pole").or_else(|| pairs().next())
}

/// By how much the drawing stands elsewhere on its page as a whole.
fn shift(old: &Panel, new: &Panel) -> Place {
    let tails = || {
        let (a, b) = (old.vectors.first()?, new.vectors.first()?);
        Some(minus(b.tail.at_mm, a.tail.at_mm))
    };
    origins(old, new).map(|(a, b)| minus(b.at_mm, a.at_mm)).or_else(tails).unwrap_or_default()
}

/// The text with a sign in the place of every number. What follows a letter is a name, as in B2.
pub(super) fn without_numbers(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut before = ' ';
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        if letter.is_numeric() && !before.is_alphabetic() {
            let part = |c: &char| c.is_numeric() || matches!(c, '.' | ',' | '٫' | '٬' | '\u{2009}');
            while letters.next_if(part).is_some() {}
            // A sign belongs to its number.
            if out.ends_with(['-', '−', '+']) {
                out.pop();
            }
            out.push('#');
            before = '#';
        } else {
            out.push(letter);
            // The digits of a name go on.
            if !(letter.is_numeric() && before.is_alphabetic()) {
                before = letter;
            }
        }
    }
    out
}

fn minus(a: Place, b: Place) -> Place {
    [a[0] - b[0], a[1] - b[1]]
}

fn length(a: Place) -> f64 {
    libm::hypot(a[0], a[1])
}

/// The angle from one vector to another, radians.
fn turn(a: Place, b: Place) -> f64 {
    libm::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1])
}

/// ` (+0.50 %)`.
fn percent(from: f64, to: f64) -> String {
    if from == 0.0 { String::new() } else { format!(" ({:+.3} %)", (to - from) / from * 100.0) }
}

/// Millimetres as people read them.
fn mm(x: f64) -> String {
    crate::render::number::decimal(x, 3)
}
