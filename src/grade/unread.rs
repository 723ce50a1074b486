//! Fields of a hand-in that are not understood: each is told with its place and mend, and the rest is graded.

use super::answers::{Answers, is_blank};
use crate::mechanism::quantity::{Measure, Quantity};
use crate::scene::Diagnostic;
use crate::scene::diagnostic::{Fault, Res};
use crate::scene::json::{self, Entry, Kind, Value};
use crate::scene::units::Words;

/// A field of a hand-in that is not understood: it answers nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct Unread {
    /// As the file names it: `v(B)`, `velocity:b`, `scales.velocity`.
    pub name: String,
    /// What it would have answered, where that is told.
    pub quantity: Option<Quantity>,
    /// What is not understood of it, where, and how to mend it.
    pub why: Diagnostic,
}

/// The same while the file is being read.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Missed {
    pub(super) name: String,
    pub(super) quantity: Option<Quantity>,
    pub(super) fault: Fault,
}

impl Answers {
    /// What a field says; nothing where it is not understood, which is noted.
    pub(super) fn grasp<T>(&mut self, name: &str, quantity: Option<Quantity>, read: Res<T>) -> Option<T> {
        read.map_err(|fault| self.miss(name, quantity, fault)).ok()
    }

    /// Notes a field that is not understood.
    pub(super) fn miss(&mut self, name: &str, quantity: Option<Quantity>, fault: Fault) {
        self.missed.push(Missed { name: name.to_owned(), quantity, fault });
    }

    /// Notes a drawing that these answers name and that cannot be read.
    pub fn miss_drawing(&mut self, why: Diagnostic) {
        self.elsewhere.push(Unread { name: "drawing".to_owned(), quantity: None, why });
    }

    /// The fields that are not understood, in the order of the file.
    #[must_use]
    pub fn unread(&self) -> Vec<Unread> {
        let document = json::parse(&self.text).ok().filter(|_| !self.missed.is_empty());
        let mut missed: Vec<&Missed> = self.missed.iter().collect();
        missed.sort_by_key(|one| one.fault.at);
        let located = missed.into_iter().map(|Missed { name, quantity, fault }| {
            let root = document.as_ref().map(|document| &document.root);
            let why = fault.clone().locate(&self.file, &self.text, root);
            Unread { name: name.clone(), quantity: *quantity, why }
        });
        located.chain(self.elsewhere.iter().cloned()).collect()
    }

    /// Of what is written more often than it is asked nobody knows which is meant: none of them is read. The fault stands
    /// at what is one too many.
    pub(super) fn void_what_is_written_twice(&mut self) {
        let mut twice: Vec<(String, Option<Quantity>, Fault)> = Vec::new();
        let mut voided: Vec<Quantity> = Vec::new();
        for quantity in self.values().map(|item| item.asked.quantity).collect::<Vec<_>>() {
            let times = self.asked.iter().filter(|asked| **asked == quantity).count().max(1);
            let written: Vec<usize> =
                self.values().filter(|item| item.asked.quantity == quantity).map(|item| item.at).collect();
            if written.len() <= times || voided.contains(&quantity) {
                continue;
            }
            voided.push(quantity);
            let order = written[times..].iter().chain(&written[..times]);
            for item in order.filter_map(|at| self.values().find(|item| item.at == *at)) {
                let name = &item.asked.name;
                let fault = Fault::new(item.at, format!("`{name}` is answered twice"));
                twice.push((name.clone(), Some(quantity), fault.mend("keep one of the two")));
            }
        }
        self.items.retain(|item| item.is_drawn() || !voided.contains(&item.asked.quantity));
        for figure in &mut self.figures {
            let names: Vec<String> = figure.points.iter().map(|(name, ..)| name.clone()).collect();
            let often = |name: &String| names.iter().filter(|other| *other == name).count() > 1;
            let figure_name = super::case::figure_name(figure.order);
            for (name, _, at) in figure.points.iter().rev().filter(|(name, ..)| often(name)) {
                let fault = Fault::new(*at, format!("`{name}` is given twice")).mend("keep one of the two");
                twice.push((format!("{figure_name}:{name}"), None, fault));
            }
            figure.points.retain(|(name, ..)| !often(name));
        }
        for (name, quantity, fault) in twice {
            self.miss(&name, quantity, fault);
        }
    }
}

/// Entries of an object, each with the byte at which the next one begins; `end` is where the object ends at the latest.
pub(super) fn spans<'e, 'a>(
    entries: &'e [Entry<'a>],
    end: usize,
) -> impl Iterator<Item = (&'e Entry<'a>, usize)> {
    let next = entries.iter().skip(1).map(|entry| entry.at).chain([end]);
    entries.iter().zip(next)
}

/// Refuses a number without a unit of its own, where what the file says of its units is not understood.
pub(super) fn refuse_bare(value: &Value<'_>, measure: Measure) -> Res<()> {
    match bare(value, measure == Measure::Number) {
        None => Ok(()),
        Some(at) => Err(Fault::new(at, "a number without a unit, and `units` is not understood")
            .mend("write its unit beside it")),
    }
}

/// Where a number without a unit stands in a value; `told` says that its unit is told beside it.
fn bare(value: &Value<'_>, told: bool) -> Option<usize> {
    match &value.kind {
        Kind::Number(_) => (!told).then_some(value.at),
        Kind::Text(text) => {
            let alone = Words::split(text).is_some_and(|words| words.unit.is_empty());
            (alone && !told).then_some(value.at)
        }
        Kind::List(list) => list.iter().find_map(|one| bare(one, told)),
        Kind::Object(entries) => {
            let unit = entries.iter().any(|entry| entry.key == "unit" && !is_blank(&entry.value));
            entries.iter().find_map(|entry| match entry.key.as_str() {
                "unit" | "sense" => None,
                "direction" | "through" => bare(&entry.value, false),
                _ => bare(&entry.value, told || unit),
            })
        }
        Kind::Null | Kind::Bool(_) => None,
    }
}
