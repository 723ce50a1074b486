//! A figure as PDF: paths and text, fonts embedded as subsets, tagged, the same bytes in every run.
//!
//! Every run of text is shaped and placed by itself, as in the SVG, and remains text: it can be searched
//! and copied. A sheet has its pages one by one. No date and no random identifier stands in the file.

use std::f64::consts::FRAC_PI_2;

use krilla::SerializeSettings;
use krilla::color::{luma, rgb};
use krilla::document::Document;
use krilla::geom::{PathBuilder, Point as PdfPoint, Transform};
use krilla::metadata::{Metadata, TextDirection as ReadingDirection};
use krilla::page::PageSettings;
use krilla::paint::{Fill, LineJoin, Paint, Stroke, StrokeDash};
use krilla::surface::Surface;
use krilla::tagging::{Artifact, ArtifactType, ContentTag, Node as TagNode, Tag, TagGroup, TagTree};
use krilla::text::{Font, TextDirection};
use kurbo::Point;
use thiserror::Error;

use super::pages::{self, Page};
use super::theme::{Place, Rgb, Theme};
use crate::sheet::figure::{Figure, Group, Mark, Node, Shape, Text, Tone, on_circle};
use crate::sheet::font::{Face, is_arabic_digit};

/// Points of PDF per millimetre.
const POINTS: f64 = 72.0 / 25.4;
/// The largest side of a page, in points: beyond it viewers refuse (PDF 1.7, annex C.2).
const LARGEST_SIDE: f64 = 14_400.0;

/// Why a figure could not be written as PDF.
#[derive(Debug, Error)]
pub enum PdfError {
    /// A page is larger than PDF allows.
    #[error(
        "a page of {width:.0} mm by {height:.0} mm is larger than PDF allows ({largest:.0} mm); choose smaller scales"
    )]
    Size {
        /// mm.
        width: f64,
        /// mm.
        height: f64,
        /// mm.
        largest: f64,
    },
    /// The writer refused.
    #[error("the PDF cannot be written: {0}")]
    Writer(String),
}

/// The figure as a PDF document.
///
/// # Errors
/// When a page is larger than PDF allows.
pub fn render(figure: &Figure, theme: Theme) -> Result<Vec<u8>, PdfError> {
    write(figure, theme, SerializeSettings::default())
}

/// The same with nothing compressed, for tests that look for numbers in its bytes.
#[cfg(test)]
pub(crate) fn render_plainly(figure: &Figure, theme: Theme) -> Result<Vec<u8>, PdfError> {
    write(
        figure,
        theme,
        SerializeSettings { compress_content_streams: false, ..SerializeSettings::default() },
    )
}

fn write(figure: &Figure, theme: Theme, how: SerializeSettings) -> Result<Vec<u8>, PdfError> {
    let mut fonts = Vec::new();
    for face in Face::ALL {
        let font = Font::new(face.bytes().into(), 0);
        fonts.push((face, font.ok_or_else(|| PdfError::Writer(format!("no font for {face:?}")))?));
    }
    let mut document = Document::new_with(how);
    let mut tags = TagTree::new().with_lang(Some(figure.language.to_owned()));
    for page in pages::of(figure) {
        let settings = settings(&page)?;
        let mut on_paper = document.start_page_with(settings);
        Writer { surface: on_paper.surface(), fonts: &fonts, theme }.page(&page, figure, &mut tags);
    }
    document.set_tag_tree(tags);
    document.set_metadata(
        Metadata::new()
            .title(figure.title.clone())
            .description(figure.description.clone())
            .language(figure.language.to_owned())
            .text_direction(reading_direction(figure.language))
            .creator("linkgram".to_owned()),
    );
    document.finish().map_err(|error| PdfError::Writer(error.to_string()))
}

/// From which side the pages of a language are read.
fn reading_direction(tag: &str) -> ReadingDirection {
    match tag.split('-').next() {
        Some("ar" | "fa") => ReadingDirection::RightToLeft,
        _ => ReadingDirection::LeftToRight,
    }
}

fn settings(page: &Page<'_>) -> Result<PageSettings, PdfError> {
    let (width, height) = (page.width * POINTS, page.height * POINTS);
    let in_range = |side: f64| side > 0.0 && side <= LARGEST_SIDE;
    let settings = PageSettings::from_wh(width as f32, height as f32);
    settings.filter(|_| in_range(width) && in_range(height)).ok_or(PdfError::Size {
        width: page.width,
        height: page.height,
        largest: LARGEST_SIDE / POINTS,
    })
}

struct Writer<'a> {
    surface: Surface<'a>,
    fonts: &'a [(Face, Font)],
    theme: Theme,
}

impl Writer<'_> {
    fn page(&mut self, page: &Page<'_>, figure: &Figure, tags: &mut TagTree) {
        let k = POINTS as f32;
        self.surface.push_transform(&Transform::from_row(k, 0.0, 0.0, k, 0.0, (-page.top * POINTS) as f32));
        if self.theme.paints_paper() {
            self.artifact();
            let (left, right) = (0.0, page.width);
            let (top, bottom) = (page.top, page.top + page.height);
            let corners = [(left, top), (right, top), (right, bottom), (left, bottom)].map(Point::from);
            self.mark(&Mark::area(Shape::Polygon(corners.to_vec()), Tone::Paper), Place::default());
            self.surface.end_tagged();
        }
        for child in &page.group.children {
            match child {
                Node::Group(group) => self.part(group, figure, tags),
                // Running title, page number and the rule between.
                leaf => {
                    self.artifact();
                    self.node(leaf, Place::default());
                    self.surface.end_tagged();
                }
            }
        }
        self.surface.pop();
    }

    /// What follows is no part of what is read: paper, running title, page number.
    fn artifact(&mut self) {
        self.surface.start_tagged(ContentTag::Artifact(Artifact::with_kind(ArtifactType::Other)));
    }

    /// A part of the page that is read at once: a drawing, with its caption for those who do not see it,
    /// or text.
    fn part(&mut self, group: &Group, figure: &Figure, tags: &mut TagTree) {
        let drawn = self.surface.start_tagged(ContentTag::Other);
        self.group(group, Place::default());
        self.surface.end_tagged();
        let mut caption = Vec::new();
        let mut strokes = 0;
        group.walk(&mut |node| match node {
            Node::Text(text) if text.class == "caption" => caption.push(text.content()),
            Node::Mark(_) => strokes += 1,
            _ => {}
        });
        let is_drawing =
            !caption.is_empty() || group.class.split(' ').any(|c| c == "skeleton" || c == "polygon");
        let mut tag = if is_drawing && strokes > 0 {
            let alternative = if caption.is_empty() { figure.title.clone() } else { caption.join("; ") };
            TagGroup::new(Tag::Figure(Some(alternative)))
        } else {
            TagGroup::new(Tag::P)
        };
        tag.push(TagNode::Leaf(drawn));
        tags.push(tag);
    }

    fn group(&mut self, group: &Group, place: Place) {
        let place = place.inside(group);
        for child in &group.children {
            self.node(child, place);
        }
    }

    fn node(&mut self, node: &Node, place: Place) {
        match node {
            Node::Group(group) => self.group(group, place),
            Node::Mark(mark) => self.mark(mark, place),
            Node::Text(text) => self.text(text, place),
        }
    }

    fn paint(&self, tone: Tone, place: Place) -> Paint {
        let Rgb([r, g, b]) = self.theme.colour(tone, place);
        // Grey as grey: a press then prints black text with black alone.
        if r == g && g == b { luma::Color::new(r).into() } else { rgb::Color::new(r, g, b).into() }
    }

    fn mark(&mut self, mark: &Mark, place: Place) {
        let mut builder = PathBuilder::new();
        outline(&mark.shape, &mut builder);
        let Some(path) = builder.finish() else { return };
        let fill = mark.fill.map(|tone| Fill { paint: self.paint(tone, place), ..Fill::default() });
        let stroke = mark.pen.map(|pen| Stroke {
            paint: self.paint(Tone::Ink, place),
            width: pen.width as f32,
            line_join: LineJoin::Round,
            dash: pen.dash.lengths().map(|lengths| StrokeDash {
                array: lengths.iter().map(|length| *length as f32).collect(),
                offset: 0.0,
            }),
            ..Stroke::default()
        });
        if fill.is_none() && stroke.is_none() {
            return;
        }
        self.surface.set_fill(fill);
        self.surface.set_stroke(stroke);
        self.surface.draw_path(&path);
    }

    fn text(&mut self, text: &Text, place: Place) {
        let paint = self.paint(Tone::Ink, place.of_words());
        self.surface.set_fill(Some(Fill { paint, ..Fill::default() }));
        self.surface.set_stroke(None);
        for run in &text.runs {
            let Some((_, font)) = self.fonts.iter().find(|(face, _)| *face == run.face) else { continue };
            let (at, size) = (point(run.at), run.size as f32);
            self.surface.draw_text(at, font.clone(), size, &run.text, false, direction(run.face, &run.text));
        }
    }
}

/// The direction of a run, which is of one script: a number runs to the right in Arabic too.
fn direction(face: Face, run: &str) -> TextDirection {
    if face.is_arabic() && !run.chars().all(is_arabic_digit) {
        TextDirection::RightToLeft
    } else {
        TextDirection::LeftToRight
    }
}

fn point(at: Point) -> PdfPoint {
    PdfPoint::from_xy(at.x as f32, at.y as f32)
}

fn outline(shape: &Shape, path: &mut PathBuilder) {
    let mut through = |points: &[Point], close: bool| {
        for (i, p) in points.iter().enumerate() {
            let PdfPoint { x, y } = point(*p);
            if i == 0 { path.move_to(x, y) } else { path.line_to(x, y) }
        }
        if close {
            path.close();
        }
    };
    match shape {
        Shape::Line(a, b) => through(&[*a, *b], false),
        Shape::Polyline(points) => through(points, false),
        Shape::Polygon(points) => through(points, true),
        Shape::Curve(curve) => {
            let n = |p: kurbo::Point| (p.x as f32, p.y as f32);
            for element in curve.elements() {
                match *element {
                    kurbo::PathEl::MoveTo(p) => path.move_to(n(p).0, n(p).1),
                    kurbo::PathEl::LineTo(p) => path.line_to(n(p).0, n(p).1),
                    kurbo::PathEl::QuadTo(a, p) => path.quad_to(n(a).0, n(a).1, n(p).0, n(p).1),
                    kurbo::PathEl::CurveTo(a, b, p) => {
                        path.cubic_to(n(a).0, n(a).1, n(b).0, n(b).1, n(p).0, n(p).1);
                    }
                    kurbo::PathEl::ClosePath => path.close(),
                }
            }
        }
        Shape::Circle { centre, radius } => {
            arc(*centre, *radius, 0.0, 4.0 * FRAC_PI_2, path);
            path.close();
        }
        Shape::Arc { centre, radius, start, sweep } => arc(*centre, *radius, *start, *sweep, path),
    }
}

/// An arc as cubic curves of at most a quarter turn each: within 3·10⁻⁴ of the radius.
fn arc(centre: Point, radius: f64, start: f64, sweep: f64, path: &mut PathBuilder) {
    let pieces = (sweep.abs() / FRAC_PI_2).ceil().clamp(1.0, 8.0);
    let step = sweep / pieces;
    let handle = 4.0 / 3.0 * libm::tan(step / 4.0) * radius;
    let at = |angle: f64| on_circle(centre, radius, angle);
    let along = |angle: f64| {
        let (sin, cos) = libm::sincos(angle);
        kurbo::Vec2::new(-sin, -cos) * handle
    };
    let first = point(at(start));
    path.move_to(first.x, first.y);
    for i in 0..pieces as usize {
        let (a, b) = (start + step * i as f64, start + step * (i + 1) as f64);
        let [c, d, e] = [at(a) + along(a), at(b) - along(b), at(b)].map(point);
        path.cubic_to(c.x, c.y, d.x, d.y, e.x, e.y);
    }
}
