//! Ink in millimetres with semantic classes: all that a renderer needs to know.
//!
//! x runs to the right and y down, as on every page. The renderer knows no mechanism; the sheet knows
//! no file format.

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Vec2};

use super::font::Face;

/// A finished drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// Width of the paper, mm.
    pub width: f64,
    /// Height of the paper, mm.
    pub height: f64,
    /// For screen readers: what it is.
    pub title: String,
    /// For screen readers: what it shows.
    pub description: String,
    /// Language tag of its text.
    pub language: &'static str,
    /// The ink.
    pub root: Group,
}

impl Figure {
    /// The pages of a sheet, each below the one before; none where the figure is one page by itself.
    #[must_use]
    pub fn pages(&self) -> Vec<&Group> {
        fn page(child: &Node) -> Option<&Group> {
            match child {
                Node::Group(group) if group.class == "page" => Some(group),
                _ => None,
            }
        }
        self.root.children.iter().map(page).collect::<Option<Vec<_>>>().unwrap_or_default()
    }
}

/// Things that belong together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Group {
    /// Classes by meaning, separated by blanks (`velocity`, `vector absolute`).
    pub class: String,
    /// Identifier, unique in its figure.
    pub id: Option<String>,
    /// `data-` attributes: name without the prefix, and value.
    pub data: Vec<(&'static str, String)>,
    /// Title for screen readers and tool tips.
    pub title: Option<String>,
    /// When it came onto the paper, where somebody asks for the drawing step by step; no renderer writes it.
    pub life: Option<Life>,
    /// What stands in it, in the order of drawing.
    pub children: Vec<Node>,
}

/// A moment of the solution: an act of a step.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Moment {
    /// Index of the step.
    pub step: usize,
    /// Index of the act in the step.
    pub act: usize,
}

/// When ink came onto the paper, and when it was used.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Life {
    /// It was drawn then.
    pub born: Moment,
    /// It was read then, if it was.
    pub read: Option<Moment>,
}

impl From<Moment> for Life {
    fn from(born: Moment) -> Self {
        Self { born, read: None }
    }
}

/// A part of a figure.
#[derive(Debug, Clone, PartialEq)]
pub enum Node {
    /// A group.
    Group(Group),
    /// A stroke or an area.
    Mark(Mark),
    /// A line of text.
    Text(Text),
}

/// A stroke or an area.
#[derive(Debug, Clone, PartialEq)]
pub struct Mark {
    /// Its geometry.
    pub shape: Shape,
    /// How its outline is drawn.
    pub pen: Option<Pen>,
    /// How its inside is filled.
    pub fill: Option<Tone>,
    /// Class by meaning; may be empty.
    pub class: &'static str,
    /// Carries a measurable length: written with six decimals of a millimetre instead of three.
    pub precise: bool,
    /// Text may stand on it (a light tint, a white ground).
    pub backdrop: bool,
}

/// Geometry of a mark.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    /// A straight stroke.
    Line(Point, Point),
    /// Strokes from point to point.
    Polyline(Vec<Point>),
    /// A closed outline.
    Polygon(Vec<Point>),
    /// A curve of Béziers.
    Curve(BezPath),
    /// A circle.
    Circle {
        /// Its centre.
        centre: Point,
        /// Its radius.
        radius: f64,
    },
    /// A circular arc. Angles in radians, counter-clockwise as seen on the page.
    Arc {
        /// Its centre.
        centre: Point,
        /// Its radius.
        radius: f64,
        /// Where it starts, from the right.
        start: f64,
        /// How far it goes, positive counter-clockwise.
        sweep: f64,
    },
}

/// How an outline is drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pen {
    /// Width of the stroke, mm.
    pub width: f64,
    /// Line type.
    pub dash: Dash,
}

/// Line types.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Dash {
    /// Continuous.
    Solid,
    /// Dashed: other positions, hidden edges.
    Dashed,
    /// Long dash, dot: axes, centre lines, pitch circles.
    Chain,
    /// Dots: what follows from something that is dashed.
    Dotted,
}

impl Dash {
    /// Lengths of strokes and gaps, mm; none for a continuous line.
    #[must_use]
    pub const fn lengths(self) -> Option<&'static [f64]> {
        match self {
            Self::Solid => None,
            Self::Dashed => Some(&[2.0, 1.0]),
            Self::Chain => Some(&[5.0, 0.9, 0.4, 0.9]),
            Self::Dotted => Some(&[0.5, 0.9]),
        }
    }
}

/// What an area is filled with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Tone {
    /// Ink.
    Ink,
    /// Paper, to cover what lies below.
    Paper,
    /// A light tint that survives a black and white printer.
    Tint,
}

/// Runs further apart than this part of their size have a blank between them.
const BLANK: f64 = 0.12;

/// A line of text: runs placed one by one.
#[derive(Debug, Clone, PartialEq)]
pub struct Text {
    /// Class by meaning; may be empty.
    pub class: &'static str,
    /// The runs, in reading order.
    pub runs: Vec<Run>,
}

/// Characters of one face and one size, at an absolute place.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The characters; a trailing blank parts words for those who copy the text.
    pub text: String,
    /// The face.
    pub face: Face,
    /// Size of the type, mm.
    pub size: f64,
    /// Start of the base line.
    pub at: Point,
}

impl Pen {
    /// A continuous stroke.
    #[must_use]
    pub const fn solid(width: f64) -> Self {
        Self { width, dash: Dash::Solid }
    }

    /// A dashed stroke.
    #[must_use]
    pub const fn dashed(width: f64) -> Self {
        Self { width, dash: Dash::Dashed }
    }

    /// A chain line.
    #[must_use]
    pub const fn chain(width: f64) -> Self {
        Self { width, dash: Dash::Chain }
    }
}

impl Mark {
    /// A stroke.
    #[must_use]
    pub fn stroke(shape: Shape, pen: Pen) -> Self {
        Self { shape, pen: Some(pen), fill: None, class: "", precise: false, backdrop: false }
    }

    /// An area without outline.
    #[must_use]
    pub fn area(shape: Shape, tone: Tone) -> Self {
        let backdrop = tone != Tone::Ink;
        Self { shape, pen: None, fill: Some(tone), class: "", precise: false, backdrop }
    }

    /// An outlined area.
    #[must_use]
    pub fn outlined(shape: Shape, pen: Pen, tone: Tone) -> Self {
        Self { shape, pen: Some(pen), fill: Some(tone), class: "", precise: false, backdrop: false }
    }

    /// The same with a class.
    #[must_use]
    pub fn class(mut self, class: &'static str) -> Self {
        self.class = class;
        self
    }

    /// The same with its coordinates written in full.
    #[must_use]
    pub fn precise(mut self) -> Self {
        self.precise = true;
        self
    }
}

impl Node {
    /// Moves it.
    pub fn translate(&mut self, by: Vec2) {
        match self {
            Self::Group(group) => group.translate(by),
            Self::Mark(mark) => mark.shape.translate(by),
            Self::Text(text) => text.runs.iter_mut().for_each(|run| run.at += by),
        }
    }
}

impl Group {
    /// An empty group.
    #[must_use]
    pub fn new(class: impl Into<String>) -> Self {
        Self { class: class.into(), ..Self::default() }
    }

    /// The same with a `data-` attribute.
    #[must_use]
    pub fn data(mut self, name: &'static str, value: impl Into<String>) -> Self {
        self.data.push((name, value.into()));
        self
    }

    /// The same with its life.
    #[must_use]
    pub fn lived(mut self, life: Option<impl Into<Life>>) -> Self {
        self.life = life.map(Into::into);
        self
    }

    /// Adds a mark.
    pub fn mark(&mut self, mark: Mark) {
        self.children.push(Node::Mark(mark));
    }

    /// Adds a mark with its life, in a group of its own where it has one.
    pub fn mark_lived(&mut self, mark: Mark, life: Option<impl Into<Life>>) {
        match life {
            None => self.mark(mark),
            life => {
                let mut own = Self::default().lived(life);
                own.mark(mark);
                self.group(own);
            }
        }
    }

    /// Adds a group that is one for its life only: without a life, what stands in it.
    pub fn adopt(&mut self, mut group: Group) {
        if group.life.is_none() {
            self.children.append(&mut group.children);
        } else if !group.children.is_empty() {
            self.group(group);
        }
    }

    /// Adds a group.
    pub fn group(&mut self, group: Group) {
        self.children.push(Node::Group(group));
    }

    /// Adds a line of text.
    pub fn text(&mut self, text: Text) {
        if !text.runs.is_empty() {
            self.children.push(Node::Text(text));
        }
    }

    /// Moves everything.
    pub fn translate(&mut self, by: Vec2) {
        self.children.iter_mut().for_each(|child| child.translate(by));
    }

    /// Calls `visit` for every mark and text in it, in the order of drawing.
    pub fn walk<'a>(&'a self, visit: &mut impl FnMut(&'a Node)) {
        for child in &self.children {
            match child {
                Node::Group(group) => group.walk(visit),
                leaf => visit(leaf),
            }
        }
    }

    /// The box of all its ink, text included.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        let mut all: Option<Rect> = None;
        self.walk(&mut |node| {
            let own = match node {
                Node::Mark(mark) => Some(mark.bounds()),
                Node::Text(text) => text.bounds(),
                Node::Group(_) => None,
            };
            if let Some(own) = own {
                all = Some(all.map_or(own, |r| r.union(own)));
            }
        });
        all
    }
}

impl Mark {
    /// The box of its ink.
    #[must_use]
    pub fn bounds(&self) -> Rect {
        let half = self.pen.map_or(0.0, |pen| pen.width / 2.0);
        self.shape.bounds().inflate(half, half)
    }
}

impl Shape {
    /// Moves it.
    pub fn translate(&mut self, by: Vec2) {
        match self {
            Self::Line(a, b) => {
                *a += by;
                *b += by;
            }
            Self::Polyline(points) | Self::Polygon(points) => points.iter_mut().for_each(|p| *p += by),
            Self::Curve(path) => path.apply_affine(Affine::translate(by)),
            Self::Circle { centre, .. } | Self::Arc { centre, .. } => *centre += by,
        }
    }

    /// The outline as straight pieces, for measuring distances; curves within 0.02 mm.
    #[must_use]
    pub fn outline(&self) -> Vec<(Point, Point)> {
        match self {
            Self::Line(a, b) => vec![(*a, *b)],
            Self::Polyline(points) => points.windows(2).map(|w| (w[0], w[1])).collect(),
            Self::Polygon(points) => {
                let next = points.iter().cycle().skip(1);
                points.iter().zip(next).map(|(a, b)| (*a, *b)).collect()
            }
            Self::Curve(path) => {
                let (mut pieces, mut at) = (Vec::new(), Point::ZERO);
                kurbo::flatten(path, 0.02, |element| match element {
                    PathEl::LineTo(to) => {
                        pieces.push((at, to));
                        at = to;
                    }
                    PathEl::MoveTo(to) => at = to,
                    _ => {}
                });
                pieces
            }
            Self::Circle { centre, radius } => chords(*centre, *radius, 0.0, std::f64::consts::TAU),
            Self::Arc { centre, radius, start, sweep } => chords(*centre, *radius, *start, *sweep),
        }
    }

    fn bounds(&self) -> Rect {
        if let Self::Circle { centre, radius } = self {
            return Rect::from_center_size(*centre, (2.0 * radius, 2.0 * radius));
        }
        let mut pieces = self.outline().into_iter();
        let Some((a, b)) = pieces.next() else { return Rect::ZERO };
        pieces.fold(Rect::from_points(a, b), |r, (a, b)| r.union_pt(a).union_pt(b))
    }
}

/// The point of a circle at this angle, counter-clockwise on a page whose y runs down.
#[must_use]
pub fn on_circle(centre: Point, radius: f64, angle: f64) -> Point {
    let (sin, cos) = libm::sincos(angle);
    Point::new(centre.x + radius * cos, centre.y - radius * sin)
}

fn chords(centre: Point, radius: f64, start: f64, sweep: f64) -> Vec<(Point, Point)> {
    // The sagitta of a chord over the angle δ is r δ²/8.
    let step = (8.0 * 0.02 / radius.max(0.01)).sqrt().clamp(0.01, 0.5);
    let pieces = (sweep.abs() / step).ceil().clamp(1.0, 2000.0);
    let at = |i: f64| on_circle(centre, radius, start + sweep * (i / pieces));
    (0..pieces as usize).map(|i| (at(i as f64), at(i as f64 + 1.0))).collect()
}

impl Text {
    /// The box of its glyphs' ink.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.boxes().into_iter().reduce(|a, b| a.union(b))
    }

    /// One box of ink per run that has any.
    #[must_use]
    pub fn boxes(&self) -> Vec<Rect> {
        self.runs.iter().filter_map(Run::bounds).collect()
    }

    /// Its characters. In a line with words of Arabic script the blanks between the runs are places only, and are
    /// told by them; brackets that were turned round for a line from right to left are turned back.
    #[must_use]
    pub fn content(&self) -> String {
        let pieces = self.pieces();
        let leftward = pieces.windows(2).any(|pair| pair[1].1[0] < pair[0].1[0]);
        let mut out = String::new();
        for (i, (runs, [low, high])) in pieces.iter().enumerate() {
            let size = runs.iter().map(|run| run.size).fold(0.0, f64::max);
            let before = i.checked_sub(1).and_then(|i| pieces.get(i));
            let apart =
                before.is_some_and(|(_, before)| f64::max(before[0] - high, low - before[1]) > BLANK * size);
            if leftward && apart && !out.ends_with(char::is_whitespace) {
                out.push(' ');
            }
            match runs {
                [run] if leftward => match run.text.trim() {
                    "(" => out.push(')'),
                    ")" => out.push('('),
                    "[" => out.push(']'),
                    "]" => out.push('['),
                    _ => out.push_str(&run.text),
                },
                runs => runs.iter().for_each(|run| out.push_str(&run.text)),
            }
        }
        out
    }

    /// The runs in pieces that run from left to right, with the left and the right end of each.
    fn pieces(&self) -> Vec<(&[Run], [f64; 2])> {
        let end = |run: &Run| run.at.x + run.face.advance(run.text.trim_end(), run.size);
        let mut pieces: Vec<(&[Run], [f64; 2])> = Vec::new();
        let mut from = 0;
        while let Some(first) = self.runs.get(from) {
            let low = first.at.x;
            let mut to = from + 1;
            if !first.face.is_arabic() {
                let joins = |run: &&Run| run.at.x >= low && !run.face.is_arabic();
                to += self.runs[to..].iter().take_while(joins).count();
            }
            let own = &self.runs[from..to];
            pieces.push((own, [low, own.iter().map(end).fold(low, f64::max)]));
            from = to;
        }
        pieces
    }
}

impl Run {
    /// The box of its glyphs' ink.
    #[must_use]
    pub fn bounds(&self) -> Option<Rect> {
        self.face.ink(&self.text, self.size).map(|ink| ink + self.at.to_vec2())
    }
}
