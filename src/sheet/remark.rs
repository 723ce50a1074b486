//! What must be said of a whole sheet, on each of its pages and in its description: that it is not confirmed, that
//! something is left out of it.

use std::collections::BTreeMap;

use kurbo::{Point, Rect, Vec2};

use super::figure::{Figure, Group, Mark, Node, Pen, Shape};
use super::labels::UNNAMED;
use super::rich::Rich;
use super::words::Language;

/// Size of the type.
const TEXT: f64 = 3.5;
/// From base line to base line.
const LEADING: f64 = 6.0;
/// The blank between the edge of the paper and the frame.
const EDGE: f64 = 2.0;
/// Where a second note stands, above the lower edge of its page: below the page's number.
const LOWER: f64 = 9.0;
/// The blank between the frame and its text.
const INSIDE: f64 = 1.0;

/// A figure with the note that the independent solver does not confirm it; `name` is the quantity that it is about, and
/// `why` all that is to be told, which stands in the data of the note.
#[must_use]
pub fn unconfirmed(figure: Figure, name: Option<&str>, why: &str, language: Language) -> Figure {
    let words = language.words();
    let text = match name {
        Some(name) => Rich::fill(words.unconfirmed, &[("what", Rich::upright(name))]),
        None => Rich::upright(words.unconfirmed_at_all),
    };
    noted(figure, &text, ("unconfirmed", why))
}

/// A figure with the note that links are left out of it, by their numbers, because nothing asked needs them and they
/// cannot be drawn for the reason `why`.
#[must_use]
pub fn left_out(figure: Figure, links: &[u32], why: &str, language: Language) -> Figure {
    let words = language.words();
    let numbers: Vec<String> = links.iter().map(u32::to_string).collect();
    let links = Rich::upright(numbers.join(words.comma));
    noted(figure, &Rich::fill(words.left_out, &[("links", links)]), ("left-out", why))
}

/// Width and height of the pages of a sheet, mm, where scales that its scene states make them larger than the paper that is
/// asked for.
#[must_use]
pub fn larger_paper(figure: &Figure, (width, height): (f64, f64)) -> Option<[f64; 2]> {
    /// As sizes of paper are rounded.
    const ROUNDED: f64 = 0.5;
    let pages = figure.pages().len();
    let own = [figure.width, figure.height / pages.max(1) as f64];
    (pages > 0 && (own[0] > width + ROUNDED || own[1] > height + ROUNDED)).then_some(own)
}

/// A sheet with the note that it needs such paper, where it does.
#[must_use]
pub fn outgrown(figure: Figure, paper: (f64, f64), language: Language) -> Figure {
    let Some([width, height]) = larger_paper(&figure, paper) else { return figure };
    let size = format!("{width:.0}\u{a0}×\u{a0}{height:.0}\u{a0}mm");
    let text = Rich::fill(language.words().larger_paper, &[("size", Rich::upright(&size))]);
    noted(figure, &text, ("paper", &size))
}

/// Names beyond which a note tells no more; all stand in its data.
const MOST_TOLD: usize = 8;

/// A figure with the note for which names it has no room, where there are any: where hundreds of names crowd, those are
/// left out that would cover one another.
#[must_use]
pub fn unnamed(figure: Figure, language: Language) -> Figure {
    let mut names = Vec::new();
    let mut groups = vec![&figure.root];
    while let Some(group) = groups.pop() {
        let here = group.data.iter().filter(|(key, _)| *key == UNNAMED);
        names.extend(here.flat_map(|(_, names)| names.split(' ').map(str::to_owned)));
        groups.extend(group.children.iter().filter_map(|node| match node {
            Node::Group(group) => Some(group),
            Node::Mark(_) | Node::Text(_) => None,
        }));
    }
    if names.is_empty() {
        return figure;
    }
    let words = language.words();
    let all = in_rows(&names);
    let mut what = all[..all.len().min(MOST_TOLD)].join(words.comma);
    if all.len() > MOST_TOLD {
        what.push('…');
    }
    noted(figure, &Rich::fill(words.unnamed, &[("what", Rich::upright(what))]), (UNNAMED, &all.join(" ")))
}

/// Names in their order, with what is numbered in a row told by its first and last: `A3–A7`.
fn in_rows(names: &[String]) -> Vec<String> {
    let mut rows: BTreeMap<(&str, &str), Vec<Option<u64>>> = BTreeMap::new();
    for name in names {
        let digit = |c: char| c.is_ascii_digit();
        let end = name.rfind(digit).map_or(name.len(), |last| last + 1);
        let start = name[..end]
            .rfind(|c| !digit(c))
            .map_or(0, |at| at + name[at..].chars().next().map_or(1, char::len_utf8));
        // `A07` is not `A7`.
        let number = name[start..end].parse().ok().filter(|n: &u64| n.to_string() == name[start..end]);
        match number {
            Some(number) => rows.entry((&name[..start], &name[end..])).or_default().push(Some(number)),
            None => rows.entry((name, "")).or_default().push(None),
        }
    }
    let mut told = Vec::new();
    for ((before, after), mut numbers) in rows {
        numbers.sort_unstable();
        numbers.dedup();
        let next =
            |a: &Option<u64>, b: &Option<u64>| a.zip(*b).is_some_and(|(a, b)| a.checked_add(1) == Some(b));
        for row in numbers.chunk_by(next) {
            let name =
                |number: Option<u64>| number.map_or(before.to_owned(), |n| format!("{before}{n}{after}"));
            match row {
                [first, .., last] => told.push(format!("{}–{}", name(*first), name(*last))),
                [only] => told.push(name(*only)),
                [] => {}
            }
        }
    }
    told
}

fn noted(mut figure: Figure, text: &Rich, (key, why): (&'static str, &str)) -> Figure {
    let is_page = |node: &Node| matches!(node, Node::Group(group) if group.class == "page");
    let pages = figure.root.children.iter().filter(|node| is_page(node)).count();
    let paged = pages > 0 && pages == figure.root.children.len();
    let page_height = figure.height / pages.max(1) as f64;
    let (width, top) = (figure.width, figure.root.children.iter().map(top_note).fold(EDGE, f64::max));
    let note = |top: f64| note(text, width, top, (key, why));
    let (_, said) = note(0.0);
    if paged {
        // The upper margin of every page is blank, and all but the page's number of the lower one.
        for (index, page) in figure.root.children.iter_mut().enumerate() {
            let Node::Group(page) = page else { continue };
            let from = match page.children.iter().filter(|node| top_note(node) > 0.0).count() {
                0 => EDGE,
                1 => page_height - LOWER,
                // There is room for two; the description tells all.
                _ => continue,
            };
            page.children.push(Node::Group(note(index as f64 * page_height + from).0));
        }
    } else {
        let (group, _) = note(top);
        let below = group.bounds().map_or(top, |bounds| bounds.y1 + EDGE);
        // What was noted before stays above.
        let lower = below - if top > EDGE { top } else { 0.0 };
        let former: Vec<Node> = std::mem::take(&mut figure.root.children);
        for mut node in former {
            if top_note(&node) <= 0.0 {
                node.translate(Vec2::new(0.0, lower));
            }
            figure.root.children.push(node);
        }
        figure.root.children.push(Node::Group(group));
        figure.height += lower;
    }
    figure.description =
        if figure.description.is_empty() { said } else { format!("{said} {}", figure.description) };
    figure
}

/// The lower edge of a note with the blank below it; zero for anything else.
fn top_note(node: &Node) -> f64 {
    match node {
        Node::Group(group) if group.class == "note" => group.bounds().map_or(0.0, |bounds| bounds.y1 + 1.0),
        _ => 0.0,
    }
}

/// The note in its frame, and what it says.
fn note(text: &Rich, width: f64, top: f64, (key, why): (&'static str, &str)) -> (Group, String) {
    let mut group = Group::new("note").data(key, why);
    let mut y = top + INSIDE;
    let mut ink: Option<Rect> = None;
    for line in text.wrap(TEXT, (width - 2.0 * (EDGE + INSIDE)).max(20.0)) {
        let line = line.set(TEXT);
        let mut own = Group::default();
        line.put(&mut own, Point::new((width - line.width) / 2.0, y + TEXT), "note");
        y += LEADING;
        if let Some(bounds) = own.bounds() {
            ink = Some(ink.map_or(bounds, |ink| ink.union(bounds)));
        }
        group.children.append(&mut own.children);
    }
    let mut said = String::new();
    group.walk(&mut |node| {
        if let Node::Text(text) = node {
            said.push_str(if said.is_empty() { "" } else { " " });
            said.push_str(&text.content());
        }
    });
    if let Some(ink) = ink {
        let frame = ink.inflate(2.0 * INSIDE, INSIDE);
        let corners =
            [(frame.x0, frame.y0), (frame.x1, frame.y0), (frame.x1, frame.y1), (frame.x0, frame.y1)];
        let outline = Shape::Polygon(corners.map(|(x, y)| Point::new(x, y)).to_vec());
        group.mark(Mark::stroke(outline, Pen::solid(0.35)));
    }
    (group, said)
}
