//! Several figures as the pages of one document, and the sheet on which answers are written.

use kurbo::{Point, Vec2};

use super::compose::localised;
use super::figure::{Figure, Group, Mark, Pen, Shape};
use super::ink::{FINE, LABEL, SMALL, THIN};
use super::notation::Notation;
use super::rich::Rich;
use super::words::Language;
use super::{Part, answers};
use crate::mechanism::quantity::Asked;
use crate::scene::Scene;

/// All pages of the figures one after the other, each in the middle of a page as large as the largest of them; nothing
/// where there is no figure.
#[must_use]
pub fn booklet(figures: &[Figure]) -> Option<Figure> {
    let mut pages: Vec<(f64, f64, Group)> = Vec::new();
    for figure in figures {
        let own = figure.pages();
        if own.is_empty() {
            let mut page = Group::new("page");
            page.group(figure.root.clone());
            pages.push((figure.width, figure.height, page));
            continue;
        }
        let count = own.len() as f64;
        for (index, group) in own.into_iter().enumerate() {
            let mut page = group.clone();
            page.translate(Vec2::new(0.0, -(index as f64) * figure.height / count));
            pages.push((figure.width, figure.height / count, page));
        }
    }
    let first = figures.first()?;
    let width = pages.iter().map(|page| page.0).fold(0.0, f64::max);
    let height = pages.iter().map(|page| page.1).fold(0.0, f64::max);
    let mut root = Group::new("booklet");
    let count = pages.len();
    for (index, (own, _, mut page)) in pages.into_iter().enumerate() {
        page.translate(Vec2::new((width - own) / 2.0, index as f64 * height));
        root.group(page);
    }
    Some(Figure {
        width,
        height: height * count as f64,
        title: first.title.clone(),
        description: String::new(),
        language: first.language,
        root,
    })
}

/// Paper of a form, mm: A4.
const PAPER: (f64, f64) = (210.0, 297.0);
/// Its border.
const MARGIN: f64 = 20.0;
/// From one box to the next.
const ROW: f64 = 13.0;
/// From one line of the title to the next.
const TITLE_LINE: f64 = 7.0;
/// A box to write in.
const BOX: (f64, f64) = (55.0, 9.0);

/// What is written on each page of so many rows: the magnitude of a vector and its direction stand on one.
fn by_pages<'n, 'a>(
    numbers: &'n [(&'a Asked, Part, String)],
    rows: usize,
) -> Vec<&'n [(&'a Asked, Part, String)]> {
    let mut pages = Vec::new();
    let (mut from, mut to) = (0, 0);
    for group in numbers.chunk_by(|one, next| one.0 == next.0) {
        if to > from && to - from + group.len() > rows {
            pages.push(&numbers[from..to]);
            from = to;
        }
        to += group.len();
    }
    if to > from {
        pages.push(&numbers[from..to]);
    }
    pages
}

/// A sheet with a box for the name, one for the variant, and one for every number that is asked, with its unit; to be
/// typed into a table that `grade` reads.
#[must_use]
pub fn answer_form(scene: &Scene, numbers: &[(&Asked, Part, String)], language: Language) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let right_to_left = words.right_to_left;
    let title = scene.title.in_language(words.tag).unwrap_or(words.untitled).to_owned();
    // A line of Arabic script begins on the right.
    let write = |page: &mut Group, text: &Rich, x: f64, y: f64, size: f64, class: &'static str| {
        let line = text.set(size);
        let x = if right_to_left { PAPER.0 - x - line.width } else { x };
        line.put(page, Point::new(x, y), class);
    };
    let write_box = |page: &mut Group, x: f64, y: f64, (width, height): (f64, f64)| {
        let x = if right_to_left { PAPER.0 - x - width } else { x };
        let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
        let shape = Shape::Polygon(corners.map(|(x, y)| Point::new(x, y)).to_vec());
        page.mark(Mark::stroke(shape, Pen::solid(THIN)).class("answer-box"));
    };
    let mut root = Group::new("form");
    let lines = Rich::bold(&title).wrap(5.0, PAPER.0 - 2.0 * MARGIN);
    let head = MARGIN + TITLE_LINE * lines.len() as f64 + 2.5 * ROW;
    let rows = ((PAPER.1 - MARGIN - BOX.1 - head) / ROW).floor().max(0.0) as usize + 1;
    let chunks = by_pages(numbers, rows);
    let count = chunks.len().max(1);
    for (index, chunk) in chunks.into_iter().enumerate() {
        let mut page = Group::new("page");
        let mut y = MARGIN;
        for line in &lines {
            write(&mut page, line, MARGIN, y, 5.0, "title");
            y += TITLE_LINE;
        }
        for (word, width) in [(words.form_name, 110.0), (words.form_variant, BOX.0)] {
            write(&mut page, &Rich::upright(word), MARGIN, y + 6.0, LABEL, "caption");
            write_box(&mut page, MARGIN + 40.0, y, (width, BOX.1));
            y += ROW;
        }
        let rule = Shape::Line(Point::new(MARGIN, y), Point::new(PAPER.0 - MARGIN, y));
        page.mark(Mark::stroke(rule, Pen::solid(FINE)));
        y += ROW / 2.0;
        for (asked, part, unit) in chunk {
            let text = Rich::fill(
                answers::prompt_words(words, asked, *part),
                &[("symbol", notation.symbol(asked.quantity, false)), ("axis", Rich::upright(part.name()))],
            );
            let lines = text.wrap(SMALL, 80.0);
            let first = y + 6.0 - 2.2 * (lines.len().saturating_sub(1)) as f64;
            for (place, line) in lines.iter().enumerate() {
                write(&mut page, line, MARGIN, first + 4.4 * place as f64, SMALL, "caption");
            }
            write_box(&mut page, MARGIN + 84.0, y, BOX);
            let unit = super::human::pretty(unit);
            write(&mut page, &Rich::upright(unit), MARGIN + 84.0 + BOX.0 + 3.0, y + 6.0, LABEL, "caption");
            y += ROW;
        }
        page.translate(Vec2::new(0.0, index as f64 * PAPER.1));
        root.group(page);
    }
    let figure = Figure {
        width: PAPER.0,
        height: PAPER.1 * count as f64,
        title,
        description: String::new(),
        language: words.tag,
        root,
    };
    localised(figure, scene)
}
