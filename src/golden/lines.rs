//! Goldens of one line: what a figure says and its drawing as checksums, all in one file.

use std::collections::BTreeMap;
use std::path::Path;

use super::meaning::without_numbers;
use super::suite::Outcome;
use super::{Change, GoldenError, Meaning, Tier, Weight};

/// The name of the file in a suite's folder that has the lines.
pub const LINES: &str = "figures.txt";

/// What the file says of itself.
const HEAD: &str = "# A figure in a line: the checksum of its SVG; then of each panel, and of the text, what it says / its numbers.\n";

/// The mark of the drawing's checksum.
const SVG: &str = "svg";
/// The mark of a refusal's checksums.
const REFUSED: &str = "refused";

/// The lines of a suite by the names of their goldens.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Lines(BTreeMap<String, String>);

impl Lines {
    /// The lines of the suite in a folder; none where it has no such file.
    pub(super) fn read(folder: &Path) -> Result<Self, GoldenError> {
        let path = folder.join(LINES);
        if !path.is_file() {
            return Ok(Self::default());
        }
        let text = std::fs::read_to_string(&path);
        let text = text.map_err(|error| GoldenError::File(format!("{}: {error}", path.display())))?;
        let mut lines = BTreeMap::new();
        for (index, line) in text.lines().enumerate() {
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            let split = line.split_once('\t').filter(|(name, _)| !lines.contains_key(*name));
            let Some((name, sums)) = split else {
                let what = "not the line of a figure, or the second of its name; take it away and bless anew";
                return Err(GoldenError::File(format!("{}:{}: {what}", path.display(), index + 1)));
            };
            lines.insert(name.to_owned(), sums.to_owned());
        }
        Ok(Self(lines))
    }

    /// The text of the file.
    pub(super) fn text(&self) -> String {
        let lines = self.0.iter().map(|(name, sums)| format!("{name}\t{sums}\n"));
        HEAD.to_owned() + &lines.collect::<String>()
    }

    pub(super) fn get(&self, name: &str) -> Option<&str> {
        self.0.get(name).map(String::as_str)
    }

    pub(super) fn names(&self) -> impl Iterator<Item = &String> {
        self.0.keys()
    }

    /// Whether anything changed.
    pub(super) fn put(&mut self, name: &str, sums: String) -> bool {
        let before = self.0.insert(name.to_owned(), sums);
        before.as_ref() != self.0.get(name)
    }

    /// Takes away the lines whose names are not kept.
    pub(super) fn retain(&mut self, kept: impl Fn(&str) -> bool) {
        self.0.retain(|name, _| kept(name));
    }
}

/// The checksums of what a scene came to, as one text.
pub(super) fn sums(outcome: &Outcome) -> Result<String, String> {
    match outcome {
        Outcome::Refusal(text) => {
            let [content, all] = [&without_numbers(text), text].map(|text| checksum(text.as_bytes()));
            Ok(format!("{REFUSED}={content:016x}/{all:016x}"))
        }
        Outcome::Figure { json, svg } => {
            let panels = Meaning::read(json)?.digests().into_iter();
            let panels =
                panels.map(|panel| format!(" {}={:08x}/{:08x}", panel.name, panel.content, panel.numbers));
            Ok(format!("{SVG}={:016x}", checksum(svg.as_bytes())) + &panels.collect::<String>())
        }
    }
}

/// Whether this is the drawing that was blessed.
pub(super) fn is_of(sums: &str, svg: &str) -> bool {
    parts(sums).get(SVG) == Some(&format!("{:016x}", checksum(svg.as_bytes())).as_str())
}

fn parts(sums: &str) -> BTreeMap<&str, &str> {
    sums.split(' ').filter_map(|part| part.split_once('=')).collect()
}

/// What differs between two lines of one golden, the weightiest first.
pub(super) fn changes(old: &str, new: &str) -> Vec<Change> {
    let (old, new) = (parts(old), parts(new));
    // A refusal in the place of a drawing, or the other way round, is the whole of the change.
    let instead = match (old.contains_key(REFUSED), new.contains_key(REFUSED)) {
        (false, true) => Some("refused now, as the scene expects"),
        (true, false) => Some("drawn now, where it was refused"),
        _ => None,
    };
    if let Some(what) = instead {
        return vec![Change::new(Weight::Content, what.to_owned())];
    }
    let mut changes = Vec::new();
    let mut tell = |weight: Weight, what: String| changes.push(Change::new(weight, what));
    for name in old.keys().chain(new.keys().filter(|name| !old.contains_key(*name))).copied() {
        let (old, new) = match (old.get(name), new.get(name)) {
            (Some(old), Some(new)) if old == new => continue,
            (Some(old), Some(new)) => (*old, *new),
            _ if name == SVG => continue,
            (None, _) => {
                tell(Weight::Content, format!("{name}: a new panel"));
                continue;
            }
            (_, None) => {
                tell(Weight::Content, format!("{name}: the whole panel is gone"));
                continue;
            }
        };
        if name == SVG {
            continue;
        }
        let [old, new] = [old, new].map(|sums| sums.split_once('/').unwrap_or((sums, "")));
        if old.1 != new.1 && old.0 == new.0 {
            tell(Weight::Number, format!("{name}: a number changed"));
        } else {
            tell(Weight::Content, format!("{name}: it says something else"));
        }
    }
    if old.get(SVG).zip(new.get(SVG)).is_some_and(|(old, new)| old != new) {
        changes.push(Change::looks(Tier::Svg, "other bytes than were blessed"));
    }
    changes.sort_by_key(|change| std::cmp::Reverse(change.weight));
    changes
}

/// FNV-1a in 64 bits: it is to see a change, not to ward off forgers.
pub(super) fn checksum(bytes: &[u8]) -> u64 {
    bytes
        .iter()
        .fold(0xcbf2_9ce4_8422_2325, |sum, byte| (sum ^ u64::from(*byte)).wrapping_mul(0x0100_0000_01b3))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn checksums_are_those_of_the_published_vectors() {
        for (text, sum) in
            [("", 0xcbf2_9ce4_8422_2325), ("a", 0xaf63_dc4c_8601_ec8c), ("foobar", 0x8594_4171_f739_67e8)]
        {
            assert_eq!(checksum(text.as_bytes()), sum);
        }
    }

    #[test]
    fn a_change_is_told_by_its_panel_and_its_weight() {
        let old = "svg=01 skeleton=a/b velocity=c/d text=e/f";
        let told = |new: &str| {
            changes(old, new).into_iter().map(|change| (change.weight, change.what)).collect::<Vec<_>>()
        };
        assert!(told(old).is_empty());
        let looks = (Weight::Cosmetic, "other bytes than were blessed".to_owned());
        assert_eq!(told("svg=02 skeleton=a/b velocity=c/d text=e/f"), std::slice::from_ref(&looks));
        assert_eq!(
            told("svg=02 skeleton=a/b velocity=c/x text=y/f"),
            [
                (Weight::Number, "velocity: a number changed".to_owned()),
                (Weight::Content, "text: it says something else".to_owned()),
                looks
            ]
        );
        assert_eq!(
            told("refused=1/2").first(),
            Some(&(Weight::Content, "refused now, as the scene expects".to_owned()))
        );
    }
}
