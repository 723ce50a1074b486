//! JSON in which every key and every value knows the byte at which it stands.

use std::collections::HashSet;
use std::fmt;

use serde::Deserialize;
use serde::de::{MapAccess, SeqAccess, Visitor};
use serde_json::value::RawValue;

use super::diagnostic::{Fault, Res};
use crate::limits;

/// More entries in one list or object than any mechanism has.
pub(crate) use crate::limits::ENTRIES as MOST;
/// Keys of an object that are told apart without a table.
const FEW: usize = 16;

/// A value and its place.
#[derive(Debug)]
pub(crate) struct Value<'a> {
    /// Byte offset in the text.
    pub(crate) at: usize,
    pub(crate) kind: Kind<'a>,
}

#[derive(Debug)]
pub(crate) enum Kind<'a> {
    Null,
    Bool(bool),
    /// A number as written.
    Number(&'a str),
    Text(String),
    List(Vec<Value<'a>>),
    Object(Vec<Entry<'a>>),
}

/// One key of an object.
#[derive(Debug)]
pub(crate) struct Entry<'a> {
    /// Byte offset of the key.
    pub(crate) at: usize,
    pub(crate) key: String,
    pub(crate) value: Value<'a>,
}

/// A text that is JSON.
#[derive(Debug)]
pub(crate) struct Document<'a> {
    pub(crate) root: Value<'a>,
    /// What no file may have although it is JSON: too many levels or entries.
    pub(crate) fault: Option<Fault>,
    /// Keys that are given twice, in the order of the text.
    pub(crate) twice: Vec<Fault>,
}

impl<'a> Document<'a> {
    /// The value, and the first thing that no scene may have although it is JSON.
    pub(crate) fn strictly(self) -> (Value<'a>, Option<Fault>) {
        let twice = self.twice.into_iter().next();
        (self.root, self.fault.into_iter().chain(twice).min_by_key(|fault| fault.at))
    }
}

/// Reads a text.
pub(crate) fn parse(text: &str) -> Res<Document<'_>> {
    if text.len() > limits::FILE {
        return Err(Fault::new(0, format!("the file is larger than {} MiB", limits::FILE >> 20)));
    }
    // Editors on some systems begin a file with a byte-order mark, which JSON does not know.
    let body = text.strip_prefix('\u{feff}').unwrap_or(text);
    let raw: &RawValue = serde_json::from_str(body).map_err(|error| {
        let before: usize =
            body.split_inclusive('\n').take(error.line().saturating_sub(1)).map(str::len).sum();
        let at = before + error.column().saturating_sub(1) + (text.len() - body.len());
        let fault = syntax(at, &error);
        match slip(text, at, &error.to_string()) {
            Some(mend) => fault.mend(mend),
            None => fault,
        }
    })?;
    let mut source = Source { text, fault: None, twice: Vec::new(), values: 0 };
    let root = source.value(raw.get(), 0)?;
    Ok(Document { root, fault: source.fault, twice: source.twice })
}

fn syntax(at: usize, error: &serde_json::Error) -> Fault {
    let message = error.to_string();
    let what = message.rsplit_once(" at line ").map_or(message.as_str(), |(what, _)| what);
    Fault::new(at, format!("not JSON: {what}"))
}

/// How to mend what people write by habit where JSON is another language than theirs.
fn slip(text: &str, at: usize, told: &str) -> Option<&'static str> {
    let at = (0..=at.min(text.len())).rev().find(|at| text.is_char_boundary(*at))?;
    let (before, rest) = text.split_at(at);
    let (last, here) = (before.trim_end().chars().last(), rest.trim_start());
    let is_at = |signs: &[char]| here.starts_with(signs) || last.is_some_and(|last| signs.contains(&last));
    if here.starts_with(['/', '#']) {
        return Some("take the comment out: JSON has none");
    }
    if is_at(&['“', '”', '„', '«', '»', '‘', '’', '\'']) {
        return Some("write straight double quotes: \"");
    }
    if here.starts_with([']', '}']) && last == Some(',') {
        return Some("take out the comma before it");
    }
    if told.starts_with("key must be a string") && here.starts_with(|c: char| c.is_ascii_digit()) {
        return Some("write a decimal point, no comma");
    }
    told.starts_with("expected `,` or").then_some("is a comma missing before it?")
}

struct Source<'a> {
    text: &'a str,
    fault: Option<Fault>,
    twice: Vec<Fault>,
    /// How many values were read.
    values: usize,
}

impl<'a> Source<'a> {
    /// Where a slice of the text stands in it.
    fn offset(&self, slice: &str) -> usize {
        (slice.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize)
    }

    /// Keeps the first fault; the rest of the text is read on, so that its path can be told.
    fn blame(&mut self, fault: Fault) {
        self.fault.get_or_insert(fault);
    }

    fn value(&mut self, raw: &'a str, depth: usize) -> Res<Value<'a>> {
        let raw = raw.trim_ascii();
        let at = self.offset(raw);
        self.values += 1;
        if self.values > limits::VALUES {
            return Err(Fault::new(at, format!("more than {} values", limits::grouped(limits::VALUES))));
        }
        let kind = match raw.as_bytes().first() {
            Some(b'{' | b'[') if depth > limits::DEPTH => {
                self.blame(Fault::new(at, format!("nested more than {} levels deep", limits::DEPTH)));
                Kind::Null
            }
            Some(b'{') => Kind::Object(self.object(raw, at, depth)?),
            Some(b'[') => {
                let Items(items) = serde_json::from_str(raw).map_err(|e| syntax(at, &e))?;
                if self.crowded(at, items.len()) {
                    return Ok(Value { at, kind: Kind::Null });
                }
                let items = items.into_iter().map(|item| self.value(item.get(), depth + 1));
                Kind::List(items.collect::<Res<_>>()?)
            }
            Some(b'"') => Kind::Text(serde_json::from_str(raw).map_err(|e| syntax(at, &e))?),
            Some(b't') => Kind::Bool(true),
            Some(b'f') => Kind::Bool(false),
            Some(b'n') | None => Kind::Null,
            Some(_) => Kind::Number(raw),
        };
        Ok(Value { at, kind })
    }

    fn object(&mut self, raw: &'a str, at: usize, depth: usize) -> Res<Vec<Entry<'a>>> {
        let Pairs(pairs) = serde_json::from_str(raw).map_err(|e| syntax(at, &e))?;
        if self.crowded(at, pairs.len()) {
            return Ok(Vec::new());
        }
        // Among few keys it is quicker to look at each.
        let mut seen = HashSet::new();
        let few = pairs.len() <= FEW;
        let mut entries: Vec<Entry<'a>> = Vec::with_capacity(pairs.len());
        for (key, value) in pairs {
            let at = self.offset(key.get());
            let key: String = serde_json::from_str(key.get()).map_err(|e| syntax(at, &e))?;
            let twice = if few { entries.iter().any(|e| e.key == key) } else { !seen.insert(key.clone()) };
            if twice {
                let fault = Fault::new(at, format!("`{key}` is given twice"));
                self.twice.push(fault.mend("keep one of the two"));
            }
            entries.push(Entry { at, key, value: self.value(value.get(), depth + 1)? });
        }
        Ok(entries)
    }

    /// A crowded list or object is blamed, and its entries are left unread.
    fn crowded(&mut self, at: usize, count: usize) -> bool {
        if count > MOST {
            self.blame(Fault::new(at, format!("{count} entries, more than {MOST}")));
        }
        count > MOST
    }
}

/// The entries of an object as slices of the text, duplicates kept.
struct Pairs<'a>(Vec<(&'a RawValue, &'a RawValue)>);

impl<'de> Deserialize<'de> for Pairs<'de> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Pairs<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("an object")
            }

            fn visit_map<M: MapAccess<'de>>(self, mut map: M) -> Result<Self::Value, M::Error> {
                let mut pairs = Vec::new();
                while let Some(pair) = map.next_entry()? {
                    pairs.push(pair);
                }
                Ok(Pairs(pairs))
            }
        }
        deserializer.deserialize_map(Collect)
    }
}

/// The items of a list as slices of the text.
struct Items<'a>(Vec<&'a RawValue>);

impl<'de> Deserialize<'de> for Items<'de> {
    fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        struct Collect;
        impl<'de> Visitor<'de> for Collect {
            type Value = Items<'de>;

            fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                f.write_str("a list")
            }

            fn visit_seq<S: SeqAccess<'de>>(self, mut seq: S) -> Result<Self::Value, S::Error> {
                let mut items = Vec::new();
                while let Some(item) = seq.next_element()? {
                    items.push(item);
                }
                Ok(Items(items))
            }
        }
        deserializer.deserialize_seq(Collect)
    }
}

impl<'a> Value<'a> {
    /// What kind of value this is, with its article.
    pub(crate) fn noun(&self) -> &'static str {
        match self.kind {
            Kind::Null => "null",
            Kind::Bool(_) => "true or false",
            Kind::Number(_) => "a number",
            Kind::Text(_) => "text",
            Kind::List(_) => "a list",
            Kind::Object(_) => "an object",
        }
    }

    /// That something else was expected here.
    pub(crate) fn unexpected(&self, expected: &str) -> Fault {
        Fault::new(self.at, format!("expected {expected}, found {}", self.noun()))
    }

    pub(crate) fn text(&self, expected: &str) -> Res<&str> {
        match &self.kind {
            Kind::Text(text) => Ok(text),
            _ => Err(self.unexpected(expected)),
        }
    }

    pub(crate) fn list(&self, expected: &str) -> Res<&[Value<'a>]> {
        match &self.kind {
            Kind::List(items) => Ok(items),
            _ => Err(self.unexpected(expected)),
        }
    }

    /// The items of a list of so many at most.
    pub(crate) fn at_most(&self, most: usize, expected: &str) -> Res<&[Value<'a>]> {
        let items = self.list(expected)?;
        if items.len() > most {
            let [count, most] = [items.len(), most].map(limits::grouped);
            return Err(Fault::new(self.at, format!("{count} entries, more than {most}")));
        }
        Ok(items)
    }

    pub(crate) fn object(&self, expected: &str) -> Res<&[Entry<'a>]> {
        match &self.kind {
            Kind::Object(entries) => Ok(entries),
            _ => Err(self.unexpected(expected)),
        }
    }

    pub(crate) fn bool(&self) -> Res<bool> {
        match self.kind {
            Kind::Bool(value) => Ok(value),
            _ => Err(self.unexpected("true or false")),
        }
    }

    /// A whole number from 0.
    pub(crate) fn whole(&self, expected: &str) -> Res<u32> {
        match self.kind {
            Kind::Number(digits) => digits.parse().map_err(|_| {
                Fault::new(self.at, format!("expected {expected}, a whole number, found {digits}"))
            }),
            _ => Err(self.unexpected(&format!("{expected}, a whole number"))),
        }
    }

    /// The keys from here to the value or key at a byte offset.
    pub(crate) fn path_to(&self, at: usize) -> String {
        let mut path = String::new();
        let mut here = self;
        while here.at != at {
            match &here.kind {
                Kind::Object(entries) => {
                    let Some(entry) = entries[..entries.partition_point(|e| e.at <= at)].last() else {
                        break;
                    };
                    if !path.is_empty() {
                        path.push('.');
                    }
                    path.push_str(&entry.key);
                    if entry.at == at {
                        break;
                    }
                    here = &entry.value;
                }
                Kind::List(items) => {
                    let index = items.partition_point(|i| i.at <= at);
                    let Some(item) = items[..index].last() else { break };
                    path.push_str(&format!("[{}]", index - 1));
                    here = item;
                }
                _ => break,
            }
        }
        path
    }
}

/// The entries of an object of which all keys are known.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fields<'v, 'a> {
    /// Byte offset of the object.
    pub(crate) at: usize,
    entries: &'v [Entry<'a>],
    known: &'static [&'static str],
}

impl<'v, 'a> Fields<'v, 'a> {
    /// The object's fields; an unknown key is an error that offers the nearest known one.
    pub(crate) fn of(value: &'v Value<'a>, known: &'static [&'static str], expected: &str) -> Res<Self> {
        let fields = Self::among(value, known, expected)?;
        fields.unknown().next().map_or(Ok(fields), |(_, fault)| Err(fault))
    }

    /// The object's fields, whatever other keys it has.
    pub(crate) fn among(value: &'v Value<'a>, known: &'static [&'static str], expected: &str) -> Res<Self> {
        Ok(Self { at: value.at, entries: value.object(expected)?, known })
    }

    /// The keys that it should not have, with what is wrong with them.
    pub(crate) fn unknown(self) -> impl Iterator<Item = (&'v str, Fault)> {
        let Self { entries, known, .. } = self;
        entries.iter().filter(|entry| !known.contains(&entry.key.as_str())).map(|entry| {
            let fault = Fault::new(entry.at, format!("unknown key `{}`", entry.key));
            (entry.key.as_str(), fault.known(&entry.key, known.iter().copied()))
        })
    }

    pub(crate) fn entry(&self, key: &str) -> Option<&'v Entry<'a>> {
        debug_assert!(self.known.contains(&key), "the reader asks for `{key}`, which no table lists");
        self.entries.iter().find(|e| e.key == key)
    }

    pub(crate) fn get(&self, key: &str) -> Option<&'v Value<'a>> {
        self.entry(key).map(|e| &e.value)
    }

    /// A key that must be there.
    pub(crate) fn need(&self, key: &str, why: &str) -> Res<&'v Value<'a>> {
        self.get(key).ok_or_else(|| Fault::new(self.at, format!("`{key}` is missing: {why}")))
    }

    /// Refuses keys that have no meaning beside others.
    pub(crate) fn refuse(&self, keys: &[&str], why: &str) -> Res<()> {
        match keys.iter().find_map(|key| self.entry(key)) {
            Some(entry) => Err(Fault::new(entry.at, format!("`{}` has no meaning here: {why}", entry.key))),
            None => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        match parse(text).map(Document::strictly) {
            Ok((_, None)) => "fine".to_owned(),
            Ok((root, Some(fault))) => fault.locate("f", text, Some(&root)).to_string(),
            Err(fault) => fault.locate("f", text, None).to_string(),
        }
    }

    #[test]
    fn offsets_and_paths() {
        let text = "\u{feff}{\"a\": [1, {\"b\": \"x\"}],\n  \"c\": null}";
        let root = parse(text).unwrap().root;
        let path = |needle: &str| root.path_to(text.find(needle).unwrap());
        assert_eq!(path("\"x\""), "a[1].b");
        assert_eq!(path("\"b\""), "a[1].b");
        assert_eq!(path("1,"), "a[0]");
        assert_eq!(path("null"), "c");
        assert_eq!(root.path_to(root.at), "");
    }

    #[test]
    fn broken_texts_are_placed() {
        assert_eq!(fault(""), "f:1:1: not JSON: EOF while parsing a value");
        assert_eq!(fault("{\n \"a\": }"), "f:2:7: not JSON: expected value");
        assert_eq!(
            fault("{\n \"a\": 1,\n \"a\": 2}"),
            "f:3:2: a: `a` is given twice; help: keep one of the two"
        );
        for (text, mend) in [
            ("{ \"a\": 7,5 }", "write a decimal point, no comma"),
            ("{ \"a\": [1, 2,] }", "take out the comma before it"),
            ("{ \"a\": 1, }", "take out the comma before it"),
            ("{ \"a\": 1 \"b\": 2 }", "is a comma missing before it?"),
            ("{ // a crank\n \"a\": 1 }", "take the comment out: JSON has none"),
            ("{ \"a\": “b” }", "write straight double quotes: \""),
            ("{ 'a': 1 }", "write straight double quotes: \""),
        ] {
            let told = fault(text);
            assert!(told.contains("not JSON") && told.ends_with(&format!("help: {mend}")), "{text}: {told}");
        }
        assert!(fault(&"[".repeat(100_000)).contains("not JSON"));
        assert!(fault(&("[".repeat(200) + &"]".repeat(200))).contains("levels deep"));
        assert!(fault(&format!("[{}0]", "0,".repeat(MOST))).contains("10001 entries"));
        assert!(fault("[\"\\ud800\"]").contains("not JSON"));
    }
}
