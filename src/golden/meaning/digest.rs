//! What a figure says, as checksums: enough to see that it changed, in which panel, and whether a number did.

use super::{Label, Line, Meaning, Panel, Place, Vector, claim, length, minus, short, without_numbers};
use crate::golden::lines::checksum;

/// Places and lengths count in hundredths of a millimetre, directions in ten-thousandths: a last digit that turns over
/// elsewhere is no changed number.
const HUNDREDTHS: f64 = 100.0;
const TEN_THOUSANDTHS: f64 = 10_000.0;

/// A part of a figure.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(in crate::golden) struct Digest {
    /// The kind of the panel, or `text` for what stands outside of panels; without blanks.
    pub(in crate::golden) name: String,
    /// Of what it says but for the numbers.
    pub(in crate::golden) content: u32,
    /// Of its numbers.
    pub(in crate::golden) numbers: u32,
}

/// What is said in no order that means anything.
#[derive(Default)]
struct Said {
    content: Vec<String>,
    numbers: Vec<String>,
}

impl Meaning {
    /// Panel by panel, and the text last.
    pub(in crate::golden) fn digests(&self) -> Vec<Digest> {
        let mut digests: Vec<Digest> = Vec::new();
        for panel in self.panels() {
            let name: String = panel.name().split_whitespace().collect::<Vec<_>>().join("-");
            let nth = 1 + digests
                .iter()
                .filter(|other| other.name.split('+').next() == Some(name.as_str()))
                .count();
            let name = if nth > 1 { format!("{name}+{nth}") } else { name };
            digests.push(Said::of_panel(panel).digest(name));
        }
        let mut text = Said::default();
        for wording in [&self.language, &self.title, &self.description] {
            text.wording("", wording);
        }
        for page in &self.pages {
            text.content.push(format!("page {} {}", page.width_mm, page.height_mm));
            text.labels(&page.texts);
        }
        digests.push(text.digest("text".to_owned()));
        digests
    }
}

impl Said {
    fn of_panel(panel: &Panel) -> Self {
        let mut said = Self::default();
        said.wording("title", &panel.title);
        said.content.push(format!("unit {:?}", panel.scale.unit));
        said.numbers.push(format!("scale {:?}", panel.scale.per_mm.map(short)));
        panel.vectors.iter().for_each(|vector| said.vector(vector));
        let origin = panel.points.iter().find(|point| point.kind == "pole").or(panel.points.first());
        for point in &panel.points {
            let name = format!("point {} {}", point.kind, point.name);
            let from = minus(point.at_mm, origin.map_or(point.at_mm, |origin| origin.at_mm));
            said.numbers.push(format!("{name} {:?}", rounded(from, HUNDREDTHS)));
            said.content.push(name);
        }
        panel.lines.iter().for_each(|line| said.line(line));
        said.labels(&panel.labels);
        for part in &panel.parts {
            let name = format!("part {:?}", part.class);
            for (key, text) in &part.data {
                match text.parse::<f64>() {
                    Ok(number) if key == "value" => said.numbers.push(format!("{name} {}", short(number))),
                    _ => said.content.push(format!("{name} {key} {text}")),
                }
            }
            said.content.push(name);
        }
        said
    }

    fn vector(&mut self, vector: &Vector) {
        let name = format!("vector {} {}", vector.name(), vector.kind);
        let drawn = rounded(minus(vector.head.at_mm, vector.tail.at_mm), HUNDREDTHS);
        self.numbers.push(format!("{name} {:?} {drawn:?}", vector.value.map(short)));
        self.content.push(format!("{name} {} {:?}", claim(vector.claim.as_ref()), vector.step));
    }

    fn line(&mut self, line: &Line) {
        let along = minus(line.to_mm, line.from_mm);
        let long = length(along);
        if long > 0.0 {
            let along = rounded(along.map(|mm| mm / long), TEN_THOUSANDTHS);
            // A line runs both ways.
            let along = if along < [0, 0] { along.map(|part| -part) } else { along };
            self.numbers.push(format!("line {} {along:?}", line.name()));
        }
        self.content.push(format!("line {}", line.name()));
    }

    fn labels(&mut self, labels: &[Label]) {
        for label in labels {
            self.wording(&format!("label {} {}", label.inside, label.class), &label.text);
        }
    }

    fn wording(&mut self, what: &str, text: &str) {
        let bare = without_numbers(text);
        if bare != text {
            self.numbers.push(format!("{what} {text}"));
        }
        self.content.push(format!("{what} {bare}"));
    }

    fn digest(self, name: String) -> Digest {
        let sum = |mut said: Vec<String>| {
            said.sort_unstable();
            let sum = checksum(said.join("\n").as_bytes());
            (sum >> 32) as u32 ^ (sum & u64::from(u32::MAX)) as u32
        };
        Digest { name, content: sum(self.content), numbers: sum(self.numbers) }
    }
}

/// In whole parts, so that there is no −0.
fn rounded(place: Place, parts: f64) -> [i64; 2] {
    place.map(|x| (x * parts).round() as i64)
}
