//! Where the parts of a mechanism stand in the file, so that later rooms can complain about them too.

use super::diagnostic::{Diagnostic, Fault};
use super::json;
use crate::mechanism::{LinkId, PointId};

/// The text of a scene and where its parts stand.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    pub(super) file: String,
    pub(super) text: String,
    pub(super) anchors: Anchors,
}

/// A part of a scene about which something can be wrong. Indices are those of the mechanism's lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// The whole scene.
    Scene,
    /// A link.
    Link(LinkId),
    /// The key that gives a link's dimensions (`links.3.length`); the link itself where it has none.
    Dimension(LinkId),
    /// A point, where it is first mentioned.
    Point(PointId),
    /// A point's `placed` or `near` value; its first mention where it has none.
    Place(PointId),
    /// A sliding pair.
    Slide(usize),
    /// A rolling pair.
    Roll(usize),
    /// All inputs: `input` or `inputs`; the whole scene where there are none.
    Inputs,
    /// One input.
    Input(usize),
    /// An asked quantity; the whole scene where `find` is absent.
    Asked(usize),
    /// A published value.
    Published(usize),
    /// How to draw; the whole scene where it is left out.
    Sheet,
    /// What variants may change; the whole scene where it is left out.
    Vary,
}

/// Byte offsets of all parts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Anchors {
    root: usize,
    links: Vec<usize>,
    dimensions: Vec<usize>,
    pub(super) points: Vec<usize>,
    pub(super) places: Vec<Option<usize>>,
    pub(super) slides: Vec<usize>,
    pub(super) rolls: Vec<usize>,
    pub(super) all_inputs: Option<usize>,
    pub(super) inputs: Vec<usize>,
    pub(super) asked: Vec<usize>,
    pub(super) published: Vec<usize>,
    pub(super) sheet: Option<usize>,
    pub(super) vary: Option<usize>,
}

impl Anchors {
    /// The frame stands for the whole file.
    pub(super) fn new(root: usize) -> Self {
        Self {
            root,
            links: vec![root],
            dimensions: vec![root],
            points: Vec::new(),
            places: Vec::new(),
            slides: Vec::new(),
            rolls: Vec::new(),
            all_inputs: None,
            inputs: Vec::new(),
            asked: Vec::new(),
            published: Vec::new(),
            sheet: None,
            vary: None,
        }
    }

    pub(super) fn add_link(&mut self, at: usize) {
        self.links.push(at);
        self.dimensions.push(at);
    }

    pub(super) fn set_dimension(&mut self, link: LinkId, at: usize) {
        if let Some(place) = self.dimensions.get_mut(link.0) {
            *place = at;
        }
    }

    /// Where a point's given place stands, or its first mention.
    pub(super) fn place(&self, point: PointId) -> usize {
        let given = self.places.get(point.0).copied().flatten();
        given.or_else(|| self.points.get(point.0).copied()).unwrap_or(self.root)
    }

    fn of(&self, subject: Subject) -> usize {
        let found = match subject {
            Subject::Scene => None,
            Subject::Link(id) => self.links.get(id.0),
            Subject::Dimension(id) => self.dimensions.get(id.0),
            Subject::Point(id) => self.points.get(id.0),
            Subject::Place(id) => return self.place(id),
            Subject::Slide(index) => self.slides.get(index),
            Subject::Roll(index) => self.rolls.get(index),
            Subject::Inputs => self.all_inputs.as_ref(),
            Subject::Input(index) => self.inputs.get(index),
            Subject::Asked(index) => self.asked.get(index),
            Subject::Published(index) => self.published.get(index),
            Subject::Sheet => self.sheet.as_ref(),
            Subject::Vary => self.vary.as_ref(),
        };
        found.copied().unwrap_or(self.root)
    }
}

impl Source {
    /// The file's name, as given to [`read`](super::read).
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }

    /// The text, as it was read.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Whether the file says what is asked: without a `find`, everything is.
    #[must_use]
    pub fn asks(&self) -> bool {
        !self.anchors.asked.is_empty()
    }

    /// What is wrong with a character, where the scene has it first; none where no text of the scene does.
    #[must_use]
    pub fn complain_of_character(&self, character: char, what: impl Into<String>) -> Option<Diagnostic> {
        let document = json::parse(&self.text).ok()?;
        let mut open = vec![&document.root];
        while let Some(value) = open.pop() {
            let found = match &value.kind {
                json::Kind::Text(text) => text.contains(character).then_some(value.at),
                json::Kind::List(items) => {
                    open.extend(items.iter().rev());
                    None
                }
                json::Kind::Object(entries) => {
                    open.extend(entries.iter().rev().map(|entry| &entry.value));
                    entries.iter().find(|entry| entry.key.contains(character)).map(|entry| entry.at)
                }
                _ => None,
            };
            if let Some(at) = found {
                return Some(Fault::new(at, what).locate(&self.file, &self.text, Some(&document.root)));
            }
        }
        None
    }

    /// What is wrong with a part of the scene, with its line, column and path.
    #[must_use]
    pub fn complain(&self, subject: Subject, what: impl Into<String>, mend: Option<String>) -> Diagnostic {
        let fault = Fault::new(self.anchors.of(subject), what);
        let fault = match mend {
            Some(mend) => fault.mend(mend),
            None => fault,
        };
        // The text was read before, so it is read again; should it fail, the path stays empty.
        let document = json::parse(&self.text).ok();
        fault.locate(&self.file, &self.text, document.as_ref().map(|d| &d.root))
    }
}
