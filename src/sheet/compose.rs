//! The page: panels with captions, tables and steps, on as many A4 pages as they need.

use std::cell::RefCell;
use std::cmp::Ordering;

use kurbo::{Point, Rect, Vec2};

use super::cycle::CyclePanel;
use super::feet::told_apart;
use super::figure::{Figure, Group, Mark, Moment, Node, Pen, Shape};
use super::font::Face;
use super::forces::ForcePanel;
use super::growth::Births;
use super::notation::Notation;
use super::panels::{self, Panel, captioned, framed};
use super::rich::Rich;
use super::skeleton::Origin;
use super::speeds::with_speeds_read;
use super::steps::{self, Item, Told};
use super::table::{Block, Table};
use super::words::{Language, Words};
use super::{auxiliary, given, growth, human, inertia, positions, results, skeleton, transfer, wanted};
use crate::graphical::auxiliary::AuxiliaryDrawing;
use crate::graphical::construction::{Act, Construction};
use crate::mechanism::PointId;
use crate::mechanism::quantity::{DiagramKind, Nature, Order, Quantity};
use crate::plan::Auxiliary;
use crate::scene::Scene;

/// Blank around the page.
const MARGIN: f64 = 17.0;
/// Blank around a single figure.
const EDGE: f64 = 4.0;
/// Type size of running text.
pub(super) const TEXT: f64 = 3.5;
/// From base line to base line of running text.
const LEADING: f64 = 4.9;
/// The same where Arabic script reaches further up and down; lines whose letters come too near keep more.
pub(super) const ARABIC_LEADING: f64 = 5.5;
/// What is on a last page and fills less of it than this is taken back to those before where they can be set tighter.
const LEAST_LAST: f64 = 0.36;
/// So much of a page before the last may be left blank, of what is within the margins.
const MOST_BLANK: f64 = 0.25;
/// How much nearer lines may stand to each other for that.
const TIGHTER: [f64; 4] = [0.97, 0.94, 0.91, 0.88];
/// Blank between the letters of two lines, at least.
const BETWEEN_LINES: f64 = 0.3;
/// The steps begin on a page that has so much room left: for a head and some lines in both columns.
const LEAST_COLUMN: f64 = 28.0;
/// The result table stands beside the skeleton if it is no taller than this.
const TALLEST_BESIDE: f64 = 112.0;
/// Blank below a row of panels.
const BELOW_ROW: f64 = 6.0;
/// So few lines of a step are no end of a sheet, and what they cost, in pages.
const MOST_TORN: usize = 4;
const LINES_OF_A_STEP: f64 = 0.15;
/// So many steps at most are held back for a last page.
const MOST_HELD: usize = 6;
/// A column of the steps is no narrower, except in a pair.
const NARROWEST_COLUMN: f64 = 82.0;
/// Nor is either of a pair narrower than this: equations and their tables would have no room.
const NARROWEST_OF_PAIR: f64 = 68.0;
/// Rows of panels are moved apart by this at most.
const MOST_SPREAD: f64 = 7.0;
/// So much blank below the panels of a page is filled with steps.
const LEAST_FILLED: f64 = 26.0;
/// Blank between the pictures of steps, and less where that saves a page.
const BETWEEN_STEPS: [f64; 4] = [8.0, 6.0, 4.0, 2.5];
/// Blank between the words of a step and the picture below them.
const ABOVE_PICTURE: f64 = 4.0;
/// From the margin to where a page begins that goes on.
const BELOW_RUNNING_TITLE: f64 = 7.0;
/// Everything.
const ORDERS: [Order; 3] = [Order::Position, Order::Velocity, Order::Acceleration];
/// Blank between panels and between columns.
const GUTTER: f64 = 8.0;
/// So few results are not parted.
const FEW_ROWS: usize = 3;
/// What a page needs above and below a drawing that has it to itself.
const ABOUT_A_BLOCK: f64 = 2.0 * MARGIN + BELOW_RUNNING_TITLE + 3.0;

/// A result table before the drawings, beside the skeleton, and one below them all.
type Way<'a> = (Option<&'a Table>, Option<&'a Table>);

/// Last steps that do not fill the room below earlier drawings.
#[derive(Debug, Clone, Copy)]
enum Held {
    /// So many go on where the others end, below all drawings.
    Back(usize),
    /// So many begin a page of their own.
    Apart(usize),
}

impl Held {
    /// None.
    const NONE: Self = Self::Back(0);
}

/// The names of the figures.
#[must_use]
pub const fn figure_names() -> &'static [&'static str] {
    &[
        "skeleton",
        "velocity",
        "acceleration",
        "centres",
        "circle",
        "transfer",
        "klein",
        "inflection",
        "centrodes",
        "kennedy",
        "rotation-centre",
        "equivalent",
        "lever",
        "results",
        "steps",
        "forces",
        "loads",
        "inertia",
        "bodies",
        "body",
        "polygons",
        "polygon",
        "shaking",
        "friction",
        "turning-moment",
        "energy",
        "controlling-force",
    ]
}

/// The solution sheet: panels, results and steps, paged.
#[must_use]
pub fn solution(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let construction = &with_speeds_read(told_apart(construction, &notation), &notation);
    let panels = Panel::all(construction).into_iter();
    let drawn: Vec<(Panel, Block)> =
        panels.filter_map(|panel| Some((panel, panel.block(construction, &notation)?))).collect();
    // Scales stated in the scene may outgrow the paper: then the paper grows, and nothing is clipped.
    let largest = |side: fn(&Block) -> f64| {
        let to_scale = drawn.iter().filter(|(panel, _)| panel.has_scale_of_its_own());
        to_scale.map(|(_, block)| side(block)).fold(0.0, f64::max)
    };
    let (width, height) = paper(scene);
    let width = width.max(largest(|b| b.width) + 2.0 * MARGIN);
    let height = height.max(largest(|b| b.height) + ABOUT_A_BLOCK);
    let given = given::paragraph(&notation);
    let beside = width - 2.0 * MARGIN - GUTTER - drawn.first().map_or(0.0, |(_, skeleton)| skeleton.width);
    let (steps, figures) = steps::items_in_figures(construction, &notation);
    let of = |orders: &[Order]| results::table(construction, &notation, &figures, orders, TEXT);
    let fits = |table: &Table| {
        !table.rows.is_empty() && table.width() <= beside && table.rows.len() <= table.rows_in(TALLEST_BESIDE)
    };
    // All results beside the skeleton, or those of velocity there and the others below the panels, or all below these.
    let (whole, slow, fast) =
        (of(&ORDERS), of(&[Order::Position, Order::Velocity]), of(&[Order::Acceleration]));
    let mut ways: Vec<Way<'_>> = Vec::new();
    if fits(&whole) {
        ways.push((Some(&whole), None));
    } else if fits(&slow) && slow.rows.len().min(fast.rows.len()) > FEW_ROWS {
        ways.push((Some(&slow), Some(&fast)));
    }
    ways.push((None, Some(&whole)));
    // Or below the skeleton, before the other panels.
    if !fits(&whole) && !whole.rows.is_empty() && whole.rows.len() <= whole.rows_in(TALLEST_BESIDE) {
        ways.push((Some(&whole), None));
    }
    let slim = || -> Vec<Block> {
        drawn.iter().filter_map(|(panel, _)| panel.slim_block(construction, &notation)).collect()
    };
    let usual: Vec<Block> = drawn.iter().map(|(_, block)| block.clone()).collect();
    // Every way of paging begins with the same lines.
    let begun: RefCell<Vec<Pager>> = RefCell::default();
    let begin = |tight: f64| {
        if let Some(known) = begun.borrow().iter().find(|known| known.tight.to_bits() == tight.to_bits()) {
            return known.clone();
        }
        let mut pager = Pager { tight, ..Pager::new(width, height, title(scene, words), words) };
        pager.heading(&given);
        pager.tell(&steps);
        begun.borrow_mut().push(pager.clone());
        pager
    };
    let set_of = |drawn: &[Block], (first, rest): Way<'_>, tight: f64, held: Held| {
        // Beside the skeleton, which is the first of them.
        let first = first.map(|table| table.draw("results", 0, table.rows.len()));
        let mut all = drawn.iter().cloned();
        let blocks: Vec<Block> = all.next().into_iter().chain(first).chain(all).collect();
        let mut pager = begin(tight);
        let held_back = pager.hold(held);
        pager.rows(&blocks);
        if let Some(table) = rest {
            pager.results(table);
        }
        pager.steps();
        if !held_back.is_empty() {
            match held {
                Held::Apart(_) => pager.page(),
                // They begin columns of their own.
                Held::Back(_) => pager.y += BELOW_ROW,
            }
            pager.waiting = held_back;
            pager.steps();
        }
        pager
    };
    let set = |way: Way<'_>, tight: f64, held: Held| set_of(&usual, way, tight, held);
    let lost = |pager: &Pager| pager.pages.len() > 1 && pager.y - MARGIN < LEAST_LAST * height;
    let first = ways[0];
    let mut best = set(first, 1.0, Held::NONE);
    if lost(&best) {
        // Some lines alone on a last page are taken back: the lines of all pages stand a little nearer to each other, or the
        // results elsewhere.
        let others = ways[1..].iter().map(|way| (*way, 1.0));
        // Letters of Arabic script reach farther up and down.
        let tighter = if words.right_to_left { &TIGHTER[..2] } else { &TIGHTER[..] };
        let closer = tighter.iter().flat_map(|tight| ways.iter().map(|way| (*way, *tight)));
        for (way, tight) in others.chain(closer) {
            let other = set(way, tight, Held::NONE);
            if !lost(&other) && other.pages.len() <= best.pages.len() {
                best = other;
                break;
            }
        }
        // Or more of the steps stand there, from a head on.
        for held in 1..=MOST_HELD {
            if !lost(&best) {
                break;
            }
            let other = set(first, 1.0, Held::Apart(held));
            if !lost(&other) && other.pages.len() == best.pages.len() {
                best = other;
            }
        }
    }
    // Where pages are still left half blank: captions broken into lines, so that more drawings stand side by side, and steps
    // kept for the pages of later drawings.
    if best.blank_of_pages() > 0.0 {
        let slim = slim();
        for blocks in [&usual, &slim] {
            for way in &ways {
                let held = (0..=MOST_HELD).map(Held::Back).chain((1..=MOST_HELD).map(Held::Apart));
                for held in held {
                    let other = set_of(blocks, *way, 1.0, held);
                    if other.better_than(&best) {
                        best = other;
                    }
                }
            }
        }
    }
    let (pages, count) = best.finish();
    let figure = Figure {
        width,
        height: height * count as f64,
        title: title(scene, words),
        description: description(construction, words),
        language: words.tag,
        root: pages,
    };
    localised(figure, scene)
}

/// The question sheet: the given data, the dimensioned skeleton, what is asked; nothing that the solution
/// finds but the position in which the skeleton is drawn.
#[must_use]
pub fn question(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    question_on(paper(scene), scene, construction, language, None)
}

/// What an answer of an examination is worth.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Marked {
    /// What is asked.
    pub quantity: Quantity,
    /// Its marks.
    pub marks: f64,
    /// So much of it is for the direction of a vector.
    pub direction: Option<f64>,
}

/// The question of an examination: it says besides how directions and senses are counted, and what each answer is worth.
#[must_use]
pub fn question_of_exam(
    scene: &Scene,
    construction: &Construction,
    language: Language,
    marked: &[Marked],
) -> Figure {
    question_on(paper(scene), scene, construction, language, Some(marked))
}

/// What a question of an examination says of its answers.
fn of_answers(notation: &Notation<'_>, marked: &[Marked]) -> Vec<Item> {
    let words = notation.words;
    let origin = counted_from(notation);
    if marked.is_empty() && origin.is_none() {
        return Vec::new();
    }
    let mut items = vec![Item::Head(Rich::bold(words.answers_head))];
    let mut say = |text: Rich| items.push(Item::Sentence(text));
    if marked.iter().any(|marked| marked.direction.is_some()) {
        say(Rich::upright(words.count_directions));
    }
    if let Some(Origin { point, at }) = origin {
        let point = ("point", notation.point(point));
        say(match at {
            [0.0, 0.0] => Rich::fill(words.count_places, &[point]),
            [x, y] => {
                let unit = &notation.scene.units.length;
                let [x, y] = [x, y].map(|metres| human::stated_quantity(metres, unit));
                Rich::fill(words.count_places_at, &[point, ("x", x), ("y", y)])
            }
        });
    }
    let turns = |marked: &Marked| super::answers::turns(marked.quantity);
    if marked.iter().any(turns) {
        say(Rich::upright(words.count_rotations));
    }
    if marked.is_empty() {
        return items;
    }
    let number = |marks: f64| Rich::upright(short_number(marks));
    let one = |marked: &Marked| {
        let symbol = notation.symbol(marked.quantity, false);
        match marked.direction {
            None => symbol.up("\u{a0}").then(&number(marked.marks)),
            Some(direction) => Rich::fill(
                words.marks_of_vector,
                &[
                    ("symbol", symbol),
                    ("marks", number(marked.marks)),
                    ("size", number(marked.marks - direction)),
                    ("direction", number(direction)),
                ],
            ),
        }
    };
    let list = Rich::join(&marked.iter().map(one).collect::<Vec<_>>(), &Rich::upright(words.comma));
    let total = number(marked.iter().map(|marked| marked.marks).sum());
    say(Rich::fill(words.marks, &[("list", list), ("total", total)]));
    items
}

/// The axes by which the places are handed in that an examination asks.
fn counted_from(notation: &Notation<'_>) -> Option<Origin> {
    let places = notation.mechanism().asked.iter().any(|asked| asked.quantity.nature() == Nature::Place);
    Origin::of(notation.mechanism()).filter(|_| places)
}

/// Marks as people write them.
fn short_number(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The same as a card of a question bank, for a screen: one page as high as it needs, without a page number.
#[must_use]
pub fn question_card(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    let mut figure = question_on_one_page(paper(scene), scene, construction, language, Some(&[]));
    if let Some(ink) = figure.root.bounds() {
        figure.height = figure.height.min(ink.y1 + MARGIN);
    }
    figure
}

/// The question for a narrow screen: one page without margins, no wider than its drawing or than lines of text ask for.
#[must_use]
pub fn question_strip(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    /// A line of text has so much room at least, mm.
    const LINE: f64 = 92.0;
    /// Blank about the ink, mm: letters of Arabic script may be wider where they are read.
    const BLANK: f64 = 2.5;
    let size = (LINE + 2.0 * MARGIN, paper(scene).1);
    let mut figure = question_on_one_page(size, scene, construction, language, None);
    if let Some(ink) = figure.root.bounds() {
        figure.root.translate(Vec2::new(BLANK - ink.x0, BLANK - ink.y0));
        (figure.width, figure.height) = (ink.width() + 2.0 * BLANK, ink.height() + 2.0 * BLANK);
    }
    figure
}

/// A question on a page that is higher than any question, without its number.
fn question_on_one_page(
    (width, height): (f64, f64),
    scene: &Scene,
    construction: &Construction,
    language: Language,
    of_exam: Option<&[Marked]>,
) -> Figure {
    /// So many times as high as its paper.
    const HIGH: f64 = 20.0;
    let mut figure = question_on((width, HIGH * height), scene, construction, language, of_exam);
    for page in &mut figure.root.children {
        if let Node::Group(page) = page {
            page.children.retain(|node| !matches!(node, Node::Text(text) if text.class == "page-number"));
        }
    }
    figure
}

fn question_on(
    (width, height): (f64, f64),
    scene: &Scene,
    construction: &Construction,
    language: Language,
    of_exam: Option<&[Marked]>,
) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let origin = of_exam.and_then(|_| counted_from(&notation));
    let (skeleton, dimensioned) = asked_skeleton(construction, &notation, origin.as_ref());
    // A turning-moment diagram may have no mechanism.
    let bare = construction.space.places.is_empty();
    let mut drawn = if bare { Vec::new() } else { vec![skeleton] };
    drawn.extend(asked_curves(construction, &notation));
    let widest = drawn.iter().fold(0.0, |most: f64, block| most.max(block.width));
    let highest = drawn.iter().fold(0.0, |most: f64, block| most.max(block.height));
    let width = width.max(widest + 2.0 * MARGIN);
    let height = height.max(highest + 4.0 * MARGIN);
    let mut pager = Pager::new(width, height, title(scene, words), words);
    pager.heading(&given::paragraph_of_question(&notation, &dimensioned));
    pager.rows(&drawn);
    let mut items = required(&notation);
    if of_exam.is_some() {
        items.extend(super::answers::all_whose(&notation).into_iter().map(Item::Sentence));
    }
    items.extend(of_exam.into_iter().flat_map(|marked| of_answers(&notation, marked)));
    let list = column(&items, pager.width(), words);
    pager.block(list);
    let (pages, count) = pager.finish();
    let figure = Figure {
        width,
        height: height * count as f64,
        title: title(scene, words),
        description: words.question.to_owned(),
        language: words.tag,
        root: pages,
    };
    localised(figure, scene)
}

/// What is to be found.
fn required(notation: &Notation<'_>) -> Vec<Item> {
    let asked = given::asked(notation).into_iter().chain(positions::asked(notation));
    let head = Item::Head(Rich::bold(notation.words.required));
    [head].into_iter().chain(asked.map(Item::Sentence)).collect()
}

/// The height that a question's text leaves to its drawing without dimension lines, mm.
pub(super) fn room_of_question(scene: &Scene) -> f64 {
    /// What dimension lines, the caption and blanks take.
    const AROUND: f64 = 62.0;
    let words = scene.sheet.language.as_deref().and_then(Language::from_tag).unwrap_or_default().words();
    let notation = Notation::new(scene, words);
    let (width, height) = paper(scene);
    let mut pager = Pager::new(width, height, title(scene, words), words);
    pager.heading(&given::paragraph_of_question(&notation, &[]));
    let list = column(&required(&notation), pager.width(), words);
    pager.bottom() - pager.y - list.height - AROUND
}

/// The dimensioned skeleton of the question, cut to its ink.
#[must_use]
pub fn single_of_question(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let (block, _) = asked_skeleton(construction, &notation, None);
    let title = format!("{}: {}", title(scene, words), words.skeleton);
    localised(cut(block.group, title, words.question.to_owned(), words), scene)
}

/// The given curves of a turning-moment diagram with their caption.
fn asked_curves(construction: &Construction, notation: &Notation<'_>) -> Option<Block> {
    let sheet = construction.cycle.as_ref()?;
    let (sheet, curves) = super::cycle::stated_curves(sheet, notation)?;
    let panel = CyclePanel::TurningMoment;
    let scale = Rich::fill(notation.words.scale, &[("scale", panel.scale(&sheet, notation))]);
    let comma = format!("{}\u{2002}", notation.words.comma.trim_end());
    Some(captioned(curves, &[panel.title(notation).up(&comma).then(&scale)]))
}

/// The dimensioned skeleton with its caption, and the points whose places it gives.
fn asked_skeleton(
    construction: &Construction,
    notation: &Notation<'_>,
    from: Option<&skeleton::Origin>,
) -> (Block, Vec<PointId>) {
    let words = notation.words;
    let unit = match notation.scene.units.length.symbol.as_str() {
        "in" => Rich::upright(words.inches),
        symbol => Rich::upright(human::pretty(symbol)),
    };
    let scale = notation.length_scale(construction.space.metres_per_mm);
    let comma = format!("{}\u{2002}", words.comma.trim_end());
    let caption = Rich::upright(words.skeleton)
        .up(&comma)
        .then(&Rich::fill(words.dimensions_in, &[("unit", unit)]))
        .up(&comma)
        .then(&Rich::fill(words.scale, &[("scale", scale)]));
    let (drawing, dimensioned) = skeleton::question(construction, notation, from);
    (captioned(drawing, &[caption]), dimensioned)
}

/// So many acts on paper are shown in one picture at most.
const ACTS: usize = 4;

/// The steps one by one: beside what is said of some acts, the drawing as it stands after them, what is new in it before
/// what is old. A diagram stands in all its pictures at one scale, with all names in their places.
#[must_use]
pub fn step_by_step(scene: &Scene, construction: &Construction, language: Language) -> Figure {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let told_apart = with_speeds_read(told_apart(construction, &notation), &notation);
    let construction = &growth::alone(&told_apart);
    let births = Births::of(construction, notation.mechanism());
    let (width, height) = paper(scene);
    let told = steps::by_step(construction, &notation);
    let mut board = Blackboard::new(construction, &notation, &births);
    let pieces = pieces(&told, construction, &births);
    let untold = untold(&pieces, construction);
    let drawn: Vec<(Piece, Vec<Block>)> = pieces
        .into_iter()
        .zip(untold)
        .map(|(piece, [before, after])| {
            let picture = piece.drawn.and_then(|drawn| board.picture(drawn, piece.upto));
            let whole = |panels: Vec<Panel>| {
                panels
                    .into_iter()
                    .filter_map(|panel| panel.block(construction, &notation))
                    .collect::<Vec<_>>()
            };
            let pictures = whole(before).into_iter().chain(picture).chain(whole(after)).collect();
            (piece, pictures)
        })
        .collect();
    let blocks = || drawn.iter().flat_map(|(_, blocks)| blocks);
    let width = width.max(blocks().map(|b| b.width).fold(0.0, f64::max) + 2.0 * MARGIN);
    let height = height.max(blocks().map(|b| b.height).fold(0.0, f64::max) + ABOUT_A_BLOCK);
    let last_of_centres = drawn.iter().rposition(|(piece, _)| piece.drawn == Some(Panel::Centres));
    let beside = |gap: f64, break_before: Option<usize>| {
        let mut pager = Pager { gap, ..Pager::new(width, height, title(scene, words), words) };
        pager.heading(&given::paragraph(&notation));
        for (i, (piece, pictures)) in drawn.iter().enumerate() {
            if break_before == Some(i) {
                pager.page();
            }
            pager.step(&piece.items, pictures);
            if last_of_centres == Some(i) {
                let circle = Panel::Circle.block(construction, &notation);
                pager.rows(&circle.into_iter().collect::<Vec<_>>());
            }
        }
        pager
    };
    // Some steps alone on a last page are taken back, all a little nearer to each other.
    let lost = |pager: &Pager| pager.pages.len() > 1 && pager.y - MARGIN < LEAST_LAST * height;
    let loose = beside(BETWEEN_STEPS[0], None);
    let closer = BETWEEN_STEPS[1..].iter().filter(|_| lost(&loose)).map(|gap| beside(*gap, None));
    let fewer = closer.into_iter().find(|pager| pager.pages.len() < loose.pages.len());
    // Or more of them stand there.
    let fuller = || {
        let breaks = (1..drawn.len()).rev().filter(|_| lost(&loose));
        let even = |pager: &Pager| !lost(pager) && pager.pages.len() == loose.pages.len();
        breaks.map(|place| beside(BETWEEN_STEPS[0], Some(place))).find(even)
    };
    let mut pager = fewer.or_else(fuller).unwrap_or(loose);
    // Pictures beside their words leave half of a page blank where the words are few or the pictures high: then they stand
    // below them, in the columns of the page.
    if pager.blank_of_pages() > 0.0 {
        let in_columns = |gap: f64| {
            let mut pager = Pager { gap, ..Pager::new(width, height, title(scene, words), words) };
            pager.heading(&given::paragraph(&notation));
            let mut run: Vec<Stacked<'_>> = Vec::new();
            for (i, (piece, pictures)) in drawn.iter().enumerate() {
                match pager.stacked(&piece.items, pictures) {
                    Some(block) => run.push(Stacked { items: &piece.items, pictures, block }),
                    None => {
                        pager = pager.after(&std::mem::take(&mut run));
                        pager.step(&piece.items, pictures);
                    }
                }
                if last_of_centres == Some(i) {
                    pager = pager.after(&std::mem::take(&mut run));
                    let circle = Panel::Circle.block(construction, &notation);
                    pager.rows(&circle.into_iter().collect::<Vec<_>>());
                }
            }
            pager.after(&run)
        };
        for gap in BETWEEN_STEPS {
            let other = in_columns(gap);
            if other.better_than(&pager) {
                pager = other;
            }
        }
    }
    let (pages, count) = pager.finish();
    let figure = Figure {
        width,
        height: height * count as f64,
        title: format!("{}: {}", title(scene, words), words.steps),
        description: description(construction, words),
        language: words.tag,
        root: pages,
    };
    localised(figure, scene)
}

/// The panels of a solution with which no act is told, before the piece of the panel that follows them, or after the last
/// of the panel that goes before: a step sheet shows what the solution shows.
fn untold(pieces: &[Piece], construction: &Construction) -> Vec<[Vec<Panel>; 2]> {
    let all = Panel::all(construction);
    let place = |panel: Panel| all.iter().position(|own| *own == panel);
    let mut out: Vec<[Vec<Panel>; 2]> = pieces.iter().map(|_| Default::default()).collect();
    let shown = |panel: &Panel| pieces.iter().any(|piece| piece.drawn == Some(*panel));
    // The circle diagram follows the centres.
    for (own, panel) in all.iter().enumerate().filter(|(_, panel)| !shown(panel) && **panel != Panel::Circle)
    {
        let earlier = |piece: &Piece| piece.drawn.and_then(place).is_some_and(|other| other < own);
        match pieces.iter().rposition(earlier) {
            Some(before) => out[before][1].push(*panel),
            None => out.iter_mut().take(1).for_each(|first| first[0].push(*panel)),
        }
    }
    out
}

/// What is said beside one picture.
struct Piece {
    items: Vec<Item>,
    drawn: Option<Panel>,
    /// How many acts on paper it tells.
    acts: usize,
    /// The last of them.
    upto: Moment,
    /// All that is told under its heads.
    whole: bool,
}

/// What is told in pieces of no more acts than one picture shows; short steps in one drawing stand together.
fn pieces(told: &[Told], construction: &Construction, births: &Births<'_>) -> Vec<Piece> {
    let mut all: Vec<Piece> = Vec::new();
    for told in told {
        // What is measured leaves nothing on the paper, and a pole alone is no picture.
        let steps = &construction.steps;
        let draws = |act: &usize| {
            let own = steps.get(told.step).and_then(|step| step.acts.get(*act));
            let bare = matches!(
                own,
                Some(
                    Act::MeasureLength { .. }
                        | Act::MarkPole
                        | Act::LeaveOutNormals { .. }
                        | Act::RollStraight { .. }
                )
            );
            !bare || !matches!(told.drawn, Some(Panel::Diagram(_)))
        };
        let acts = told.acts.iter().flatten().filter(|act| draws(act)).count();
        let parts = acts.div_ceil(ACTS).max(1);
        // As even as they get: no picture for a last line.
        let upto = |part: usize| (acts * part).div_ceil(parts);
        let step = if told.drawn == Some(Panel::Centres) { births.last().step + 1 } else { told.step };
        let fresh = || Piece {
            items: Vec::new(),
            drawn: told.drawn,
            acts: 0,
            upto: Moment { step, act: 0 },
            whole: parts == 1,
        };
        let mut own = vec![fresh()];
        let mut shown = 0;
        for (item, act) in told.items.iter().zip(&told.acts) {
            let counts = act.as_ref().is_some_and(draws);
            if counts && shown == upto(own.len()) {
                own.push(fresh());
            }
            shown += usize::from(counts);
            let Some(piece) = own.last_mut() else { continue };
            piece.items.push(item.clone());
            piece.acts += usize::from(counts);
            if let Some(act) = *act {
                piece.upto.act = piece.upto.act.max(act);
            }
        }
        // With the last act the step is done.
        if let Some(last) = own.last_mut() {
            last.upto.act = usize::MAX;
        }
        for piece in own {
            match all.last_mut() {
                Some(before)
                    if before.whole
                        && (piece.whole || before.acts == 0)
                        && before.drawn == piece.drawn
                        && matches!(piece.drawn, Some(Panel::Diagram(_)))
                        && before.acts + piece.acts <= ACTS =>
                {
                    before.items.extend(piece.items);
                    before.acts += piece.acts;
                    before.upto = piece.upto;
                    before.whole = piece.whole;
                }
                _ => all.push(piece),
            }
        }
    }
    all
}

/// A piece that fits into a column.
struct Stacked<'a> {
    items: &'a [Item],
    pictures: &'a [Block],
    /// Its words with its pictures below them.
    block: Block,
}

/// How many acts on paper each picture of the steps shows.
#[cfg(test)]
pub(super) fn acts_of_pictures(construction: &Construction, notation: &Notation<'_>) -> Vec<usize> {
    let births = Births::of(construction, notation.mechanism());
    pieces(&steps::by_step(construction, notation), construction, &births)
        .iter()
        .map(|piece| piece.acts)
        .collect()
}

/// The finished diagrams, each drawn once, and how far it has been shown.
struct Blackboard<'a> {
    construction: &'a Construction,
    notation: &'a Notation<'a>,
    births: &'a Births<'a>,
    finished: Vec<Finished>,
}

struct Finished {
    of: Panel,
    ink: Group,
    /// The left and right end of the finished drawing: in all its pictures every point stands equally far to the right.
    sides: [f64; 2],
    caption: Vec<Rich>,
    shown: Option<Moment>,
}

impl<'a> Blackboard<'a> {
    fn new(construction: &'a Construction, notation: &'a Notation<'a>, births: &'a Births<'a>) -> Self {
        Self { construction, notation, births, finished: Vec::new() }
    }

    /// The place of a diagram among the finished ones, drawn when it is first asked for.
    fn index(&mut self, of: Panel) -> Option<usize> {
        if let Some(index) = self.finished.iter().position(|finished| finished.of == of) {
            return Some(index);
        }
        let ink = of.drawing(self.construction, self.notation, Some(self.births))?;
        let caption = of.caption(self.construction, self.notation)?;
        // The skeleton under the centres stood there before.
        let shown = (of == Panel::Centres).then_some(Moment { act: usize::MAX, ..self.births.last() });
        let last = Moment { step: usize::MAX, act: usize::MAX };
        let plain = growth::without_asides(&growth::at(&ink, Some(last), last));
        let room = plain.bounds().unwrap_or(Rect::ZERO);
        self.finished.push(Finished { of, ink, sides: [room.x0, room.x1], caption, shown });
        Some(self.finished.len() - 1)
    }

    /// The picture of a drawing after this act; none where nothing new is in it.
    fn picture(&mut self, of: Panel, upto: Moment) -> Option<Block> {
        match of {
            Panel::Transfer(_) | Panel::Auxiliary(_) | Panel::Force(_) | Panel::Cycle(_) => {
                of.block(self.construction, self.notation)
            }
            of => {
                let index = self.index(of)?;
                let own = &mut self.finished[index];
                let since = own.shown.replace(upto);
                growth::changes(&own.ink, since, upto).then(|| {
                    let picture = growth::without_asides(&growth::at(&own.ink, since, upto));
                    let ink = picture.bounds().unwrap_or(Rect::ZERO);
                    let [left, right] = own.sides;
                    let frame = Rect::new(left.min(ink.x0), ink.y0, right.max(ink.x1), ink.y1);
                    framed(picture, frame, &own.caption)
                })
            }
        }
    }
}

/// The figures of a film, all of one size: the diagrams as they stand after each step, or after so many acts of a longer one
/// as one picture shows, each in its place, and the head of the step below them.
#[must_use]
pub fn film(scene: &Scene, construction: &Construction, language: Language) -> Vec<Figure> {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let told_apart = with_speeds_read(told_apart(construction, &notation), &notation);
    let construction = &growth::alone(&told_apart);
    let births = Births::of(construction, notation.mechanism());
    // The places of the diagrams are those that the finished ones need: the skeleton, below it the others in pairs.
    let finished: Vec<(Group, Rect)> = Panel::diagrams(construction)
        .into_iter()
        .filter_map(|panel| panel.drawing(construction, &notation, Some(&births)))
        .map(|drawing| {
            let ink = drawing.bounds().unwrap_or(Rect::ZERO).inflate(EDGE, EDGE);
            (drawing, ink)
        })
        .collect();
    let (skeleton, others) = finished.split_at(1.min(finished.len()));
    let rows: Vec<&[(Group, Rect)]> = [skeleton].into_iter().chain(others.chunks(2)).collect();
    let wide = |row: &[(Group, Rect)]| row.iter().map(|(_, ink)| ink.width()).sum::<f64>();
    let told = steps::by_step(construction, &notation);
    let heads = told.iter().filter_map(|told| match told.items.first() {
        Some(Item::Head(text)) => Some(text.set(TEXT).width + 2.0 * EDGE),
        _ => None,
    });
    let width = rows.iter().map(|row| wide(row)).chain(heads).fold(0.0, f64::max);
    let mut corners: Vec<Point> = Vec::new();
    let mut below = 0.0;
    for row in &rows {
        let mut left = (width - wide(row)) / 2.0;
        for (_, ink) in *row {
            corners.push(Point::new(left, below));
            left += ink.width();
        }
        below += row.iter().map(|(_, ink)| ink.height()).fold(0.0, f64::max);
    }
    let head = below + 2.0 * TEXT;
    let parts = |told| pieces(std::slice::from_ref(told), construction, &births);
    let shown: Vec<(&Told, Moment)> =
        told.iter().flat_map(|told| parts(told).into_iter().map(move |piece| (told, piece.upto))).collect();
    let last = shown.len().saturating_sub(1);
    let mut since: Option<Moment> = None;
    let frames = shown.into_iter().enumerate().map(|(i, (told, upto))| {
        let mut root = Group::new("frame").data("step", (told.step + 1).to_string());
        for ((finished, ink), corner) in finished.iter().zip(&corners) {
            // At the end all is of one colour.
            let mut own = if i == last { finished.clone() } else { growth::at(finished, since, upto) };
            own.translate(*corner - ink.origin());
            root.group(own);
        }
        since = Some(upto);
        if let Some(Item::Head(text)) = told.items.first() {
            let line = text.set(TEXT);
            line.put(&mut root, Point::new(((width - line.width) / 2.0).max(0.0), head - TEXT), "heading");
        }
        let figure = Figure {
            width,
            height: head + EDGE,
            title: format!("{}: {}", title(scene, words), words.steps),
            description: description(construction, words),
            language: words.tag,
            root,
        };
        localised(figure, scene)
    });
    frames.collect()
}

/// One figure, cut to its ink; `None` for an unknown name, or where the construction has no such figure.
#[must_use]
pub fn single(scene: &Scene, construction: &Construction, name: &str, language: Language) -> Option<Figure> {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let construction = &with_speeds_read(told_apart(construction, &notation), &notation);
    let parts = Part::all(name, 0, true, construction, &notation)?;
    Some(stack(&parts.into_iter().map(|part| part.cut(scene, words)).collect::<Vec<_>>()))
}

/// A figure that is wished for.
#[derive(Debug, Clone)]
pub enum Wished<'a> {
    /// One of a construction, by its name.
    Named(&'a str),
    /// One that is drawn already.
    Drawn(Box<Figure>),
}

/// Several figures: below each other, cut to their ink, as long as they are no larger than the paper; else on its pages.
///
/// # Errors
/// The place of the first among them that the construction does not have.
pub fn figures(
    scene: &Scene,
    construction: &Construction,
    wished: &[Wished<'_>],
    language: Language,
) -> Result<Figure, usize> {
    let words = language.words();
    let notation = Notation::new(scene, words);
    let construction = &with_speeds_read(told_apart(construction, &notation), &notation);
    // What the steps tell of a construction is told once.
    let with_words = !wished.iter().any(|own| matches!(own, Wished::Named("steps")));
    let mut parts: Vec<Part> = Vec::new();
    for (place, own) in wished.iter().enumerate() {
        let before = parts.iter().filter(|part| part.lettered()).count();
        match own {
            Wished::Named(name) => {
                let own = Part::all(name, before, with_words, construction, &notation);
                parts.extend(own.ok_or(place)?);
            }
            Wished::Drawn(figure) => parts.push(Part::Figure((**figure).clone())),
        }
    }
    let (width, height) = paper(scene);
    let strip: Vec<Figure> = parts.iter().map(|part| part.clone().cut(scene, words)).collect();
    let whole = stack(&strip);
    let fits = whole.width <= width && whole.height <= height;
    let goes_on = parts.len() > 1 || parts.iter().any(|part| matches!(part, Part::Words(_)));
    if fits || !goes_on {
        return Ok(whole);
    }
    let largest =
        |side: fn(&Block) -> f64| parts.iter().filter_map(Part::block).map(side).fold(0.0, f64::max);
    let width = width.max(largest(|block| block.width) + 2.0 * MARGIN);
    let height = height.max(largest(|block| block.height) + ABOUT_A_BLOCK);
    let mut pager = Pager::new(width, height, title(scene, words), words);
    pager.heading(&given::paragraph(&notation));
    let mut row: Vec<Block> = Vec::new();
    let mut told: Vec<Item> = Vec::new();
    let flush = |pager: &mut Pager, row: &mut Vec<Block>, told: &mut Vec<Item>| {
        pager.rows(&std::mem::take(row));
        if !told.is_empty() {
            pager.tell(&std::mem::take(told));
            pager.steps();
            pager.y += BELOW_ROW;
        }
    };
    for part in parts {
        // What is said of a drawing stands below it, before the next one.
        if !told.is_empty() {
            flush(&mut pager, &mut row, &mut told);
        }
        match part {
            Part::Words(items) => told = items,
            Part::Panel { block, items, .. } => {
                row.push(block);
                told = items;
            }
            Part::Results(table) => {
                flush(&mut pager, &mut row, &mut told);
                pager.results(&table);
            }
            Part::Table(block, _) => row.push(block),
            Part::Figure(figure) => {
                row.push(Block { width: figure.width, height: figure.height, group: figure.root });
            }
        }
    }
    flush(&mut pager, &mut row, &mut told);
    let (root, count) = pager.finish();
    let titles: Vec<&str> = strip.iter().map(|figure| figure.title.as_str()).collect();
    let figure = Figure {
        width,
        height: height * count as f64,
        title: titles.join("; "),
        description: whole.description,
        language: words.tag,
        root,
    };
    Ok(localised(figure, scene))
}

/// A piece of what is shown for the name of a figure.
#[derive(Clone)]
enum Part {
    /// A drawing with its caption and what is said of it.
    Panel { block: Block, heading: &'static str, items: Vec<Item> },
    /// The results.
    Results(Table),
    /// Another table.
    Table(Block, &'static str),
    /// The steps.
    Words(Vec<Item>),
    /// What was drawn elsewhere.
    Figure(Figure),
}

impl Part {
    /// What is shown for a name after so many drawings that have letters, with what is said of a construction or without; none
    /// where there is nothing of this name.
    fn all(
        name: &str,
        before: usize,
        with_words: bool,
        construction: &Construction,
        notation: &Notation<'_>,
    ) -> Option<Vec<Self>> {
        let words = notation.words;
        let lettered = |panels: Vec<Panel>, heading: &'static str| {
            let blocks = panels.into_iter().enumerate();
            let blocks = blocks.filter_map(|(i, panel)| panel.block_at(before + i, construction, notation));
            let all: Vec<Self> =
                blocks.map(|block| Self::Panel { block, heading, items: Vec::new() }).collect();
            (!all.is_empty()).then_some(all)
        };
        match name {
            "skeleton" => lettered(vec![Panel::SKELETON], words.skeleton),
            "velocity" => lettered(vec![Panel::Diagram(DiagramKind::Velocity)], words.velocity_diagram),
            "acceleration" => {
                lettered(vec![Panel::Diagram(DiagramKind::Acceleration)], words.acceleration_diagram)
            }
            "centres" => lettered(vec![Panel::Centres], words.centres_figure),
            "circle" => lettered(vec![Panel::Circle], words.circle_diagram),
            "transfer" => {
                let count = transfer::by_method(construction.circle.as_ref()?).len();
                lettered((0..count).map(Panel::Transfer).collect(), words.transfer_figure)
            }
            "results" => {
                let (_, figures) = steps::items_in_figures(construction, notation);
                Some(vec![Self::Results(results::table(construction, notation, &figures, &ORDERS, TEXT))])
            }
            "steps" => Some(vec![Self::Words(steps::items(construction, notation))]),
            "turning-moment" | "energy" => {
                let sheet = construction.cycle.as_ref()?;
                let panel = CyclePanel::all(sheet).into_iter().find(|panel| panel.figure() == name)?;
                lettered(vec![Panel::Cycle(panel)], words.turning_moment_figure)
            }
            "inertia" => {
                let (_, figures) = steps::items_in_figures(construction, notation);
                let table = inertia::table(construction, notation, &figures, TEXT)?;
                Some(vec![Self::Table(table.draw("inertia", 0, table.rows.len()), words.inertia_figure)])
            }
            name if wanted::is_of_forces(name) => {
                let sheet = construction.forces.as_ref()?;
                let name: String = name.chars().filter(|c| !c.is_whitespace()).collect();
                let two = ForcePanel::of_two(&name, sheet, notation);
                let own = ForcePanel::all(sheet).into_iter();
                let own = own.filter(|panel| panel.belongs_to(&name, sheet, notation)).chain(two);
                lettered(own.map(Panel::Force).collect(), words.loads_figure)
            }
            _ => {
                let kind = wanted::auxiliary(name, notation.scene).ok()??;
                let drawing =
                    construction.auxiliary.iter().find(|a| a.kind == kind && a.refused.is_none())?;
                let panel = panels::of_auxiliary(drawing, construction)?;
                let block = panel.block_at(before, construction, notation)?;
                let items = if with_words { words_of(drawing, construction, notation) } else { Vec::new() };
                Some(vec![Self::Panel { block, heading: words.auxiliary_figure, items }])
            }
        }
    }

    /// Whether it has a letter.
    const fn lettered(&self) -> bool {
        matches!(self, Self::Panel { .. })
    }

    /// What takes its place on a page as it is.
    const fn block(&self) -> Option<&Block> {
        match self {
            Self::Panel { block, .. } | Self::Table(block, _) => Some(block),
            Self::Results(_) | Self::Words(_) | Self::Figure(_) => None,
        }
    }

    /// Alone, cut to its ink.
    fn cut(self, scene: &Scene, words: &'static Words) -> Figure {
        match self {
            Self::Panel { block, heading, items } => {
                tight(scene, with_steps(block, &items, words), heading, words)
            }
            Self::Table(block, heading) => tight(scene, block, heading, words),
            Self::Results(table) => {
                tight(scene, table.draw("results", 0, table.rows.len()), words.results, words)
            }
            Self::Words(items) => tight(scene, column(&items, 90.0, words), words.steps, words),
            Self::Figure(figure) => figure,
        }
    }
}

/// A drawing cut to its ink.
pub(super) fn tight(scene: &Scene, block: Block, heading: &str, words: &Words) -> Figure {
    let mut description = String::new();
    block.group.walk(&mut |node| match node {
        Node::Text(text) if text.class == "caption" => {
            description.push_str(if description.is_empty() { "" } else { "; " });
            description.push_str(&text.content());
        }
        _ => {}
    });
    let title = format!("{}: {heading}", title(scene, words));
    localised(cut(block.group, title, description, words), scene)
}

/// A drawing as a figure of its own, tight to its ink.
pub(super) fn cut(mut root: Group, title: String, description: String, words: &Words) -> Figure {
    let ink = root.bounds().unwrap_or(Rect::ZERO);
    root.translate(Vec2::new(EDGE - ink.x0, EDGE - ink.y0));
    Figure {
        width: ink.width() + 2.0 * EDGE,
        height: ink.height() + 2.0 * EDGE,
        title,
        description,
        language: words.tag,
        root,
    }
}

/// What is said of a construction on the skeleton; its caption says already what the head would say.
fn words_of(drawing: &AuxiliaryDrawing, construction: &Construction, notation: &Notation<'_>) -> Vec<Item> {
    let index = construction.auxiliary.iter().position(|own| own.kind == drawing.kind).unwrap_or_default();
    let ((rates, items), _) = steps::settled(|figures| {
        let rates = match drawing.kind {
            Auxiliary::Klein { .. } => steps::conversions(notation, figures),
            _ => Vec::new(),
        };
        (rates, auxiliary::items(index, construction, notation, figures))
    });
    rates.into_iter().map(Item::Sentence).chain(items.into_iter().skip(1)).collect()
}

/// A drawing with what is said of it below.
fn with_steps(mut block: Block, items: &[Item], words: &Words) -> Block {
    if items.is_empty() {
        return block;
    }
    let mut steps = column(items, block.width.max(120.0), words);
    let width = block.width.max(steps.width);
    block.group.translate(Vec2::new((width - block.width) / 2.0, 0.0));
    steps.group.translate(Vec2::new(0.0, block.height + 2.0));
    block.group.group(steps.group);
    Block { width, height: block.height + 2.0 + steps.height, ..block }
}

/// The decimal sign that the scene wishes, in everything that is set but what the scene's own title says.
pub(super) fn localised(mut figure: Figure, scene: &Scene) -> Figure {
    if scene.sheet.decimal_comma {
        commas(&mut figure.root);
    }
    figure
}

fn commas(group: &mut Group) {
    for child in &mut group.children {
        match child {
            Node::Group(group) => commas(group),
            Node::Text(text) if !matches!(text.class, "title" | "running-title") => {
                text.runs.iter_mut().for_each(|run| run.text = with_comma(&run.text));
            }
            Node::Text(_) | Node::Mark(_) => {}
        }
    }
}

/// A point between two digits becomes a comma, which is as wide.
fn with_comma(text: &str) -> String {
    let characters: Vec<char> = text.chars().collect();
    let digit = |i: Option<usize>| i.and_then(|i| characters.get(i)).is_some_and(char::is_ascii_digit);
    let sign = |(i, c): (usize, &char)| {
        if *c == '.' && digit(i.checked_sub(1)) && digit(Some(i + 1)) { ',' } else { *c }
    };
    characters.iter().enumerate().map(sign).collect()
}

/// Several figures below each other as one.
#[must_use]
pub fn stack(figures: &[Figure]) -> Figure {
    let mut root = Group::new("figures");
    let mut y = 0.0;
    let width = figures.iter().map(|f| f.width).fold(0.0, f64::max);
    for figure in figures {
        let mut group = figure.root.clone();
        group.translate(Vec2::new((width - figure.width) / 2.0, y));
        root.group(group);
        y += figure.height;
    }
    let titles: Vec<&str> = figures.iter().map(|f| f.title.as_str()).collect();
    let told = figures.iter().map(|f| f.description.as_str()).filter(|told| !told.is_empty());
    Figure {
        width,
        height: y,
        title: titles.join("; "),
        description: told.collect::<Vec<_>>().join("; "),
        language: figures.first().map_or("en", |f| f.language),
        root,
    }
}

fn title(scene: &Scene, words: &Words) -> String {
    scene.title.in_language(words.tag).unwrap_or(words.untitled).to_owned()
}

fn description(construction: &Construction, words: &Words) -> String {
    let mut what = vec![words.skeleton];
    what.extend(construction.diagrams.iter().map(|diagram| panels::title(diagram.kind, words)));
    words.description.replace("{what}", &what.join(words.comma).to_lowercase())
}

/// Width and height of the paper, mm.
#[must_use]
pub fn paper(scene: &Scene) -> (f64, f64) {
    let stated = scene.sheet.paper.as_deref().unwrap_or_default().to_ascii_lowercase();
    let mut words = stated.split_whitespace();
    let (width, height) = match words.next() {
        Some("a0") => (841.0, 1189.0),
        Some("a1") => (594.0, 841.0),
        Some("a2") => (420.0, 594.0),
        Some("a3") => (297.0, 420.0),
        Some("a5") => (148.0, 210.0),
        Some("a6") => (105.0, 148.0),
        Some("letter") => (215.9, 279.4),
        Some("legal") => (215.9, 355.6),
        _ => (210.0, 297.0),
    };
    if words.next() == Some("landscape") { (height, width) } else { (width, height) }
}

/// Width and height of the paper within its margins, mm.
#[must_use]
pub(super) fn free_paper(scene: &Scene) -> (f64, f64) {
    let (width, height) = paper(scene);
    let free = |side: f64| (side - 2.0 * MARGIN).max(40.0);
    (free(width), free(height))
}

fn leading(words: &Words) -> f64 {
    if words.right_to_left { ARABIC_LEADING } else { LEADING }
}

/// How far below `above` what is set in `below` must stand to keep clear of it, both set on one base line.
pub(super) fn clear_of(above: &[Rect], below: &[Rect]) -> f64 {
    let beside = |a: &Rect, b: &Rect| a.x0 < b.x1 && b.x0 < a.x1;
    let pairs = above.iter().flat_map(|a| below.iter().filter(move |b| beside(a, b)).map(move |b| (a, b)));
    pairs.map(|(a, b)| a.y1 - b.y0 + BETWEEN_LINES).fold(0.0, f64::max)
}

/// The boxes of the texts in a group.
fn text_boxes(group: &Group) -> Vec<Rect> {
    let mut all = Vec::new();
    group.walk(&mut |node| {
        if let Node::Text(text) = node {
            all.extend(text.boxes());
        }
    });
    all
}

/// The boxes of the rules of a table in a group.
fn rules(group: &Group) -> Vec<Rect> {
    let mut all = Vec::new();
    group.walk(&mut |node| {
        if let Node::Mark(mark) = node
            && mark.class == "rule"
        {
            all.push(mark.bounds());
        }
    });
    all
}

/// The lines of a column, with what may not be parted from the next line.
#[derive(Clone)]
struct Strip {
    group: Group,
    height: f64,
    /// Blank above, left out on top of a column.
    blank: f64,
    keep: bool,
}

/// Strips that may not be parted: the blank on top of them, and the height of all.
#[derive(Debug, Clone, Copy)]
struct Chunk {
    blank: f64,
    height: f64,
}

impl Chunk {
    fn of(strips: &[Strip]) -> Self {
        let blank = strips.first().map_or(0.0, |strip| strip.blank);
        Self { blank, height: strips.iter().map(|strip| strip.height).sum() }
    }
}

/// How many chunks go into each of so many columns of this height; into the first at least one where it must stand here,
/// so that a chunk too tall for any column does not stop the sheet.
fn split(chunks: &[Chunk], height: f64, must: bool, columns: usize) -> Vec<usize> {
    let mut rest = chunks;
    let fill = |column: usize| {
        let least = usize::from(must && column == 0);
        let mut used = -rest.first().map_or(0.0, |chunk| chunk.blank);
        let mut count = 0;
        for chunk in rest {
            used += chunk.height;
            if used > height && count >= least {
                break;
            }
            count += 1;
        }
        rest = &rest[count..];
        count
    };
    (0..columns).map(fill).collect()
}

/// The same, of the last chunks as low as all fit.
fn even_split(chunks: &[Chunk], free: f64, must: bool, count: usize) -> Vec<usize> {
    let mut columns = split(chunks, free, must, count);
    if columns.iter().sum::<usize>() == chunks.len() {
        let whole: f64 = chunks.iter().map(|chunk| chunk.height).sum();
        let mut height = free.min(whole);
        while height > LEADING {
            let lower = split(chunks, height - LEADING / 2.0, must, count);
            if lower.iter().sum::<usize>() < chunks.len() {
                break;
            }
            columns = lower;
            height -= LEADING / 2.0;
        }
    }
    columns
}

/// An equation's table in one line, with type a little smaller if need be, or else in as many lines as it takes.
fn terms_in(table: &Table, width: f64) -> Vec<Table> {
    let mut lines = Vec::new();
    let mut rest = table.clone();
    loop {
        let fitted = rest.clone().fitted(width);
        if fitted.size > 0.84 * rest.size {
            lines.push(fitted);
            return lines;
        }
        // The longest first line that fits; the next begins with a sign. Signs stand between the terms, and after the labels
        // of a line that goes on.
        let first_sign = 2 + lines.len().min(1);
        let signs = (first_sign..rest.columns.len()).step_by(2).rev();
        let split = signs.map(|column| rest.split(column)).find(|(first, _)| first.fits(width));
        let Some((first, second)) = split.filter(|(_, second)| second.columns.len() < rest.columns.len())
        else {
            lines.push(fitted);
            return lines;
        };
        lines.push(first);
        rest = second;
    }
}

/// Whether lines are set, or only how high they are is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Ink {
    Set,
    Measured,
}

/// The items of the steps as strips of this width, their lines so near to each other.
fn strips(items: &[Item], width: f64, words: &Words, tight: f64, ink: Ink) -> Vec<Strip> {
    let leading = tight * leading(words);
    // Where a piece of this width begins that is so far from the edge at which the reader begins.
    let at = |indent: f64, own: f64| if words.right_to_left { width - indent - own } else { indent };
    let put = |text: &Rich, group: &mut Group, indent: f64, y: f64, class: &'static str| {
        if ink == Ink::Set {
            let line = text.set(TEXT);
            line.put(group, Point::new(at(indent, line.width), y), class);
        }
    };
    let mut all = Vec::new();
    for (i, item) in items.iter().enumerate() {
        match item {
            Item::Head(text) => {
                for (k, line) in text.wrap(TEXT, width).iter().enumerate() {
                    let mut group = Group::new("step-head");
                    let above = if k == 0 { 3.2 * tight } else { 0.0 };
                    put(line, &mut group, 0.0, above + TEXT, "heading");
                    let height = above + leading + 0.4;
                    all.push(Strip { group, height, blank: above, keep: true });
                }
            }
            Item::Terms(table) => {
                let tables = terms_in(table, width);
                for (k, table) in tables.iter().enumerate() {
                    let mut group = Group::new("terms");
                    if ink == Ink::Set {
                        let block = table.draw("terms", 0, table.rows.len());
                        group = block.group;
                        group.translate(Vec2::new(at(0.0, block.width), 1.2));
                    }
                    let height = table.height(0, table.rows.len());
                    let keep = k + 1 < tables.len() || matches!(items.get(i + 1), Some(Item::Sentence(_)));
                    let below = if k + 1 < tables.len() { 1.4 } else { 3.2 };
                    all.push(Strip { group, height: height + below, blank: 0.0, keep });
                }
            }
            Item::Sentence(text) => {
                let told = words.right_to_left.then(|| text.among_right_to_left());
                let lines = told.as_ref().unwrap_or(text).wrap(TEXT, width - 4.0);
                for (k, line) in lines.iter().enumerate() {
                    let mut group = Group::new("sentence");
                    if k == 0 {
                        put(&Rich::upright("–"), &mut group, 0.0, TEXT, "mark");
                    }
                    put(line, &mut group, 4.0, TEXT, "sentence");
                    all.push(Strip { group, height: leading, blank: 0.0, keep: k + 1 < lines.len() });
                }
            }
        }
    }
    keep_lines_together(&mut all);
    if words.right_to_left {
        // Letters of Arabic script reach up and down by very different amounts.
        for i in 1..all.len() {
            let (above, mut below) = (text_boxes(&all[i - 1].group), text_boxes(&all[i].group));
            below.extend(rules(&all[i].group));
            all[i - 1].height = all[i - 1].height.max(clear_of(&above, &below));
        }
    }
    all
}

/// No head stands over a single line at the end of a column, and no single line of a step at the top of the next.
fn keep_lines_together(strips: &mut [Strip]) {
    let head = |strip: &Strip| strip.group.class == "step-head";
    let line = |strip: &Strip| strip.group.class == "sentence";
    let last = strips.len().saturating_sub(1);
    for i in 1..last {
        let first_of_step = line(&strips[i]) && head(&strips[i - 1]);
        let before_last = line(&strips[i + 1]) && (i + 1 == last || head(&strips[i + 2]));
        // The head of the next step is not tied to this one.
        if (first_of_step || before_last) && !head(&strips[i + 1]) {
            strips[i].keep = true;
        }
    }
}

/// All strips below each other.
fn column(items: &[Item], width: f64, words: &Words) -> Block {
    let mut group = Group::new("steps");
    let mut y = 0.0;
    for mut strip in strips(items, width, words, 1.0, Ink::Set) {
        strip.group.translate(Vec2::new(0.0, y));
        y += strip.height;
        group.group(strip.group);
    }
    Block { group, width, height: y }
}

/// Panels in their order, side by side where they fit.
fn in_rows<T>(blocks: &[T], free: f64, width: impl Fn(&T) -> f64) -> Vec<Vec<&T>> {
    let mut rows: Vec<Vec<&T>> = Vec::new();
    for block in blocks {
        let used = |row: &Vec<&T>| row.iter().map(|b| width(b) + GUTTER).sum::<f64>();
        match rows.last_mut() {
            Some(row) if used(row) + width(block) <= free => row.push(block),
            _ => rows.push(vec![block]),
        }
    }
    rows
}

/// A sheet of which the text is known, but not yet how large its diagrams are: how they would fill its pages.
pub(super) struct Draft {
    pager: Pager,
    chunks: Vec<Chunk>,
    /// Results: all of them, and those of the accelerations.
    results: [usize; 2],
}

/// How full the pages of a draft are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Filled {
    pub(super) pages: usize,
    /// How much of the last page is used, as a part of its height.
    pub(super) last: f64,
}

/// Width of the result table, about.
const RESULTS: f64 = 65.0;

impl Draft {
    /// The draft of a sheet in the scene's own language, on its own paper.
    pub(super) fn of(scene: &Scene, drawn: &Construction) -> Self {
        let words = scene.sheet.language.as_deref().and_then(Language::from_tag).unwrap_or_default().words();
        let notation = Notation::new(scene, words);
        let (width, height) = paper(scene);
        let mut pager = Pager::new(width, height, title(scene, words), words);
        pager.heading(&given::paragraph(&notation));
        // Of its lines only the heights are asked; those of Arabic script depend on their letters.
        let ink = if words.right_to_left { Ink::Set } else { Ink::Measured };
        pager.tell_in(&steps::items(drawn, &notation), ink);
        let chunks = pager.waiting.iter().map(|strips| Chunk::of(strips)).collect();
        let results = [results::count(&notation, &ORDERS), results::count(&notation, &[Order::Acceleration])];
        Self { pager, chunks, results }
    }

    /// How the pages fill with blocks of these widths and heights, the skeleton first, where the text is so much longer and
    /// has so much more, and with so much below all, mm.
    pub(super) fn filled(&self, blocks: &[[f64; 2]], (longer, more): (f64, f64), spare: f64) -> Filled {
        /// More than any sheet has.
        const MOST_LINES: f64 = 100_000.0;
        let pager = &self.pager;
        let by = |chunk: &Chunk| Chunk { blank: longer * chunk.blank, height: longer * chunk.height };
        let further =
            (0..(more / LEADING).min(MOST_LINES) as usize).map(|_| Chunk { blank: 0.0, height: LEADING });
        let chunks: Vec<Chunk> = self.chunks.iter().copied().chain(further).map(|chunk| by(&chunk)).collect();
        let (bottom, count) = (pager.bottom(), pager.column_count());
        let table = |rows: usize| (rows as f64 + 1.4) * 1.62 * TEXT;
        let [all, fast] = self.results;
        let beside = pager.width() - GUTTER - blocks.first().map_or(0.0, |[width, _]| *width);
        let fits = |rows: usize| rows > 0 && RESULTS <= beside && table(rows) <= TALLEST_BESIDE;
        let (first, mut rest) = match () {
            () if fits(all) => (Some(all), 0),
            () if fits(all - fast) => (Some(all - fast), fast),
            () => (None, all),
        };
        let first = first.map(|rows| [RESULTS, table(rows)]);
        let blocks: Vec<[f64; 2]> =
            blocks.iter().take(1).copied().chain(first).chain(blocks.iter().skip(1).copied()).collect();
        let (mut pages, mut y, mut next) = (1, pager.y, 0);
        let begin = |pages: &mut usize, y: &mut f64| {
            *pages += 1;
            *y = MARGIN + BELOW_RUNNING_TITLE;
        };
        // As many of the steps as the page still takes; whether any.
        let columns = |y: &mut f64, next: &mut usize| {
            let waiting = &chunks[*next..];
            let mut left = waiting.iter();
            let columns = even_split(waiting, bottom - *y, *y <= MARGIN + 8.0, count);
            let heights = columns.iter().map(|own| left.by_ref().take(*own).map(|c| c.height).sum::<f64>());
            *y += heights.fold(0.0, f64::max);
            let taken: usize = columns.iter().sum();
            *next += taken;
            taken > 0
        };
        for row in in_rows(&blocks, pager.width(), |[width, _]| *width) {
            let height = row.iter().map(|[_, height]| *height).fold(0.0, f64::max);
            if y + height > bottom && y > MARGIN + 30.0 {
                if bottom - y >= LEAST_FILLED {
                    columns(&mut y, &mut next);
                }
                begin(&mut pages, &mut y);
            }
            y += height + BELOW_ROW;
        }
        while rest > 0 {
            // In two columns.
            let fit = ((bottom - y) / (1.62 * TEXT) - 1.4).floor().max(0.0) as usize;
            if fit < 3.min(rest) && y > MARGIN + 30.0 {
                if bottom - y >= LEAST_FILLED {
                    columns(&mut y, &mut next);
                }
                begin(&mut pages, &mut y);
                continue;
            }
            let here = rest.min(2 * fit.max(1));
            y += table(here.div_ceil(2)) + 8.0;
            rest -= here;
        }
        while next < chunks.len() {
            if bottom - y < LEAST_COLUMN || !columns(&mut y, &mut next) {
                begin(&mut pages, &mut y);
            }
        }
        y += spare;
        if y > bottom {
            pages += 1;
            y += MARGIN + BELOW_RUNNING_TITLE - bottom;
        }
        Filled { pages, last: (y - MARGIN) / pager.paper.1 }
    }
}

#[derive(Clone)]
struct Pager {
    paper: (f64, f64),
    title: String,
    words: &'static Words,
    pages: Vec<Group>,
    /// Where what stands on the pages before the last one ends.
    ends: Vec<f64>,
    /// Next free height on the last page, below its top.
    y: f64,
    /// Whether no more than some lines of a step that begins before stand last.
    torn: bool,
    /// The steps that are not set yet, in pieces that may not be parted.
    waiting: Vec<Vec<Strip>>,
    /// How near the lines of the steps stand to each other, 1 as usual.
    tight: f64,
    /// Blank below the picture of a step.
    gap: f64,
}

impl Pager {
    fn new(width: f64, height: f64, title: String, words: &'static Words) -> Self {
        Self {
            paper: (width, height),
            title,
            words,
            pages: vec![Group::new("page")],
            ends: Vec::new(),
            y: MARGIN,
            torn: false,
            waiting: Vec::new(),
            tight: 1.0,
            gap: BETWEEN_STEPS[0],
        }
    }

    fn width(&self) -> f64 {
        self.paper.0 - 2.0 * MARGIN
    }

    /// Columns of the steps: two, more on paper that would make their lines too long, one on paper that would break them.
    fn column_count(&self) -> usize {
        /// Of paper that is larger than any sheet may be, too.
        const MOST: f64 = 2_000.0;
        let least = if self.width() - GUTTER < 2.0 * NARROWEST_OF_PAIR { 1.0 } else { 2.0 };
        ((self.width() + GUTTER) / (NARROWEST_COLUMN + GUTTER)).floor().clamp(least, MOST) as usize
    }

    fn column(&self) -> f64 {
        let count = self.column_count() as f64;
        (self.width() - (count - 1.0) * GUTTER) / count
    }

    fn bottom(&self) -> f64 {
        self.paper.1 - MARGIN - 3.0
    }

    fn page(&mut self) {
        self.ends.push(self.y);
        self.torn = false;
        self.pages.push(Group::new("page"));
        self.y = MARGIN + BELOW_RUNNING_TITLE;
    }

    /// Where a piece of this width begins that is so far from the edge at which the reader begins.
    fn indented(&self, indent: f64, width: f64) -> f64 {
        if self.words.right_to_left { self.paper.0 - indent - width } else { indent }
    }

    fn add(&mut self, mut group: Group, x: f64, y: f64) {
        group.translate(Vec2::new(x, y));
        if let Some(page) = self.pages.last_mut() {
            page.group(group);
        }
    }

    /// Title and given data on top of the first page.
    fn heading(&mut self, given: &Rich) {
        let mut group = Group::new("heading");
        let mut y = 0.0;
        let from_edge = |width: f64| self.indented(MARGIN, width) - MARGIN;
        for line in Rich::written(&self.title, Face::Bold).wrap(5.6, self.width()) {
            y += 6.2;
            let line = line.set(5.6);
            line.put(&mut group, Point::new(from_edge(line.width), y), "title");
        }
        y += 1.0;
        let mut above = text_boxes(&group);
        above.iter_mut().for_each(|own| *own = *own - Vec2::new(0.0, y));
        for line in given.wrap(TEXT, self.width()) {
            let line = line.set(TEXT);
            let below = line.boxes_at(Point::new(from_edge(line.width), 0.0));
            let crowded = if self.words.right_to_left { clear_of(&above, &below) } else { 0.0 };
            y += leading(self.words).max(crowded);
            line.put(&mut group, Point::new(from_edge(line.width), y), "given");
            above = below;
        }
        let deepest = above.iter().map(|own| own.y1).fold(0.0, f64::max);
        y += if self.words.right_to_left { f64::max(2.6, deepest + 0.8) } else { 2.6 };
        let rule = Shape::Line(Point::new(0.0, y), Point::new(self.width(), y));
        group.mark(Mark::stroke(rule, Pen::solid(0.35)).class("rule"));
        let top = self.y - 4.0;
        self.add(group, MARGIN, top);
        self.y = top + y + 6.0;
    }

    /// A block below what stands already.
    fn block(&mut self, block: Block) {
        if self.y + block.height > self.bottom() && self.y > MARGIN + 30.0 {
            self.page();
        }
        let (x, y) = (self.indented(MARGIN, block.width), self.y);
        self.y += block.height + 6.0;
        self.add(block.group, x, y);
    }

    /// What is said of a step, and its drawings beside it, or above it where they are too wide.
    fn step(&mut self, items: &[Item], drawings: &[Block]) {
        let Some(widest) = drawings.iter().map(|drawing| drawing.width).reduce(f64::max) else {
            return self.block(column(items, self.column(), self.words));
        };
        // Narrow words give way to a wide drawing.
        let words = (self.width() - GUTTER - widest).min(self.column());
        if words < NARROWEST_OF_PAIR.min(self.column()) {
            return self.step_below(items, drawings);
        }
        let text = column(items, words, self.words);
        let beside = self.width() - GUTTER - words;
        let first = drawings.first().map_or(0.0, |drawing| drawing.height);
        if self.y + text.height.max(first) > self.bottom() && self.y > MARGIN + 30.0 {
            self.page();
        }
        let x = self.indented(MARGIN, text.width);
        let mut deepest = self.y + text.height;
        self.add(text.group, x, self.y);
        for (i, drawing) in drawings.iter().enumerate() {
            if i > 0 && self.y + drawing.height > self.bottom() && self.y > MARGIN + 30.0 {
                self.page();
                deepest = self.y;
            }
            let free = (beside - drawing.width) / 2.0;
            let far = self.indented(MARGIN + words + GUTTER + free, drawing.width);
            self.add(drawing.group.clone(), far, self.y);
            self.y += drawing.height + BELOW_ROW;
        }
        self.y = deepest.max(self.y - BELOW_ROW) + self.gap;
    }

    /// What is said of a step with its drawings below it, as wide as a column; none where they do not fit into one.
    fn stacked(&self, items: &[Item], drawings: &[Block]) -> Option<Block> {
        let width = self.column();
        let text = column(items, width, self.words);
        let mut group = Group::new("step");
        let mut height = text.height;
        group.group(text.group);
        for drawing in drawings {
            let mut own = drawing.group.clone();
            own.translate(Vec2::new((width - drawing.width) / 2.0, height + ABOVE_PICTURE));
            group.group(own);
            height += drawing.height + ABOVE_PICTURE;
        }
        let fits = drawings.iter().all(|drawing| drawing.width <= width);
        let free = self.bottom() - MARGIN - BELOW_RUNNING_TITLE;
        (fits && self.column_count() > 1 && height <= free).then_some(Block { group, width, height })
    }

    /// The pages after these steps: the first ones with their drawings beside them, the others in columns, as soon as that
    /// takes fewest pages and least of the last one.
    fn after(self, steps: &[Stacked<'_>]) -> Self {
        let with = |beside: usize| {
            let mut pager = self.clone();
            let (beside, in_columns) = steps.split_at(beside);
            for step in beside {
                pager.step(step.items, step.pictures);
            }
            pager.in_columns(in_columns);
            pager
        };
        let ways = (1..=steps.len()).map(with);
        ways.fold(with(0), |best, other| {
            let less = |own: &Self| (own.pages.len(), own.y);
            if less(&other) < less(&best) { other } else { best }
        })
    }

    /// Steps with their drawings one after the other down the columns of the pages, as even as they get.
    fn in_columns(&mut self, steps: &[Stacked<'_>]) {
        let gap = self.gap;
        let chunks: Vec<Chunk> =
            steps.iter().map(|step| Chunk { blank: 0.0, height: step.block.height + gap }).collect();
        let (width, count) = (self.column(), self.column_count());
        let mut from = 0;
        while from < steps.len() {
            let empty = self.y <= MARGIN + BELOW_RUNNING_TITLE + 1.0;
            // Below the last of a column no blank is needed.
            let free = self.bottom() - self.y + gap;
            let columns = even_split(&chunks[from..], free, empty, count);
            let (top, mut deepest) = (self.y, self.y);
            let mut own = steps[from..].iter();
            for (column, taken) in columns.iter().enumerate() {
                let x = self.indented(MARGIN + column as f64 * (width + GUTTER), width);
                let mut y = top;
                for step in own.by_ref().take(*taken) {
                    self.add(step.block.group.clone(), x, y);
                    y += step.block.height + gap;
                }
                deepest = deepest.max(y);
            }
            self.y = deepest;
            from += columns.iter().sum::<usize>();
            if from < steps.len() {
                self.page();
            }
        }
    }

    /// Drawings over the whole width, and below them what is said of them, in the columns of the sheet.
    fn step_below(&mut self, items: &[Item], drawings: &[Block]) {
        self.tell(items);
        let waiting = std::mem::take(&mut self.waiting);
        let chunks: Vec<Chunk> = waiting.iter().map(|strips| Chunk::of(strips)).collect();
        let free = self.bottom() - MARGIN;
        let columns = even_split(&chunks, free, true, self.column_count());
        let mut left = chunks.iter();
        let heights =
            columns.iter().map(|own| left.by_ref().take(*own).map(|chunk| chunk.height).sum::<f64>());
        let text = heights.fold(0.0, f64::max);
        // The last drawing and its words stand on one page where they can.
        let last = drawings.last().map_or(0.0, |drawing| drawing.height);
        let together = last + BELOW_ROW + text;
        if drawings.len() == 1 && self.y + together > self.bottom() && self.y > MARGIN + 30.0 {
            self.page();
        }
        self.rows(drawings);
        self.waiting = waiting;
        while !self.waiting.is_empty() {
            if !self.columns() {
                self.page();
            }
        }
        self.y += self.gap;
    }

    /// Moves the rows of a page apart where the next one does not fit on it: what is left blank is not all below.
    fn spread(&mut self, begins: &[usize]) {
        let left = self.bottom() - (self.y - BELOW_ROW);
        let gap = (left / (begins.len() as f64 + 1.0)).min(MOST_SPREAD);
        let Some(page) = self.pages.last_mut() else { return };
        for (i, begin) in begins.iter().enumerate() {
            let end = begins.get(i + 1).copied().unwrap_or(page.children.len());
            for node in &mut page.children[*begin..end] {
                if let Node::Group(group) = node {
                    group.translate(Vec2::new(0.0, gap * (i as f64 + 1.0)));
                }
            }
        }
    }

    /// Panels in their order, side by side where they fit.
    fn rows(&mut self, blocks: &[Block]) {
        let rows = in_rows(blocks, self.width(), |block| block.width);
        // Where each row of this page begins among its pieces.
        let mut begins: Vec<usize> = Vec::new();
        for row in rows {
            let height = row.iter().map(|b| b.height).fold(0.0, f64::max);
            if self.y + height > self.bottom() && self.y > MARGIN + 30.0 {
                // Where a page has room below its panels the steps begin there.
                if self.bottom() - self.y < LEAST_FILLED || !self.columns() {
                    self.spread(&begins);
                }
                begins.clear();
                self.page();
            }
            begins.push(self.pages.last().map_or(0, |page| page.children.len()));
            let blank = self.width() - row.iter().map(|b| b.width).sum::<f64>();
            let between = blank / (row.len() as f64 + 1.0);
            let mut x = MARGIN + between;
            let y = self.y;
            for block in row {
                // Captions of a row stand on one line; a table stands in the middle.
                let free = height - block.height;
                let down = if block.group.class == "panel" { free } else { free / 2.0 };
                self.add(block.group.clone(), self.indented(x, block.width), y + down);
                x += block.width + between;
            }
            self.y += height + self.blank(BELOW_ROW);
        }
    }

    /// A blank between blocks, which gives way sooner than lines.
    fn blank(&self, usual: f64) -> f64 {
        /// How much sooner.
        const SOONER: f64 = 4.0;
        usual * (1.0 - SOONER * (1.0 - self.tight))
    }

    /// The result table in so many columns, in type a little smaller if need be; none where it would be much smaller.
    fn results_in(&self, columns: usize, table: &Table) -> Option<Table> {
        let width = (self.width() - (columns as f64 - 1.0) * GUTTER) / columns as f64;
        let narrow = table.clone().fitted(width);
        (narrow.fits(width) && narrow.size > 0.8 * table.size).then_some(narrow)
    }

    /// The result table in columns of even height, on as many pages as it needs: two columns, or three
    /// where that keeps it on the page, or one on paper too narrow for two.
    fn results(&mut self, table: &Table) {
        let rows = table.rows.len();
        let pair = self.results_in(2, table);
        // A few rows are one table.
        let usual = if pair.is_some() && rows > FEW_ROWS { 2 } else { 1 };
        let three = pair.as_ref().and_then(|_| self.results_in(3, table));
        let table = &pair.unwrap_or_else(|| table.clone().fitted(self.width()));
        let mut from = 0;
        while from < rows {
            let fit = table.rows_in(self.bottom() - self.y);
            let left = rows - from;
            // What has room on one page is looked for on one page.
            let whole = table.rows_in(self.bottom() - MARGIN - BELOW_RUNNING_TITLE);
            let here = fit * if three.is_some() { 3 } else { usual };
            let torn = from == 0 && left > here && left <= usual * whole;
            if (fit < 3.min(left) || torn) && self.y > MARGIN + 30.0 {
                if self.bottom() - self.y >= LEAST_FILLED {
                    self.columns();
                }
                self.page();
                continue;
            }
            let (columns, table) = match &three {
                Some(narrow) if left > 2 * fit && left <= 3 * fit => (3, narrow),
                _ => (usual, table),
            };
            let here = left.min(columns * fit.max(1));
            // Some last rows alone on a page are lost there.
            if (1..=6).contains(&(left - here)) && self.y > MARGIN + 30.0 {
                if self.bottom() - self.y >= LEAST_FILLED {
                    self.columns();
                }
                self.page();
                continue;
            }
            let each = here.div_ceil(columns);
            let pitch = self.width() / columns as f64;
            let mut deepest = self.y;
            for column in 0..columns {
                let (a, b) = (from + column * each, from + here.min((column + 1) * each));
                if a < b {
                    let block = table.draw("results", a, b);
                    let x = MARGIN + column as f64 * pitch + ((pitch - block.width) / 2.0).max(0.0);
                    let y = self.y;
                    deepest = deepest.max(y + block.height);
                    self.add(block.group, self.indented(x, block.width), y);
                }
            }
            self.y = deepest + self.blank(8.0);
            from += here;
        }
    }

    /// What is told of the steps, to be set below the panels and where they leave room.
    fn tell(&mut self, items: &[Item]) {
        self.tell_in(items, Ink::Set);
    }

    fn tell_in(&mut self, items: &[Item], ink: Ink) {
        let mut chunks: Vec<Vec<Strip>> = vec![Vec::new()];
        for strip in strips(items, self.column(), self.words, self.tight, ink) {
            let keep = strip.keep;
            if let Some(chunk) = chunks.last_mut() {
                chunk.push(strip);
            }
            if !keep {
                chunks.push(Vec::new());
            }
        }
        chunks.retain(|chunk| !chunk.is_empty());
        self.waiting = chunks;
    }

    /// All steps that are not set yet.
    fn steps(&mut self) {
        while !self.waiting.is_empty() {
            if self.bottom() - self.y < LEAST_COLUMN || !self.columns() {
                self.page();
            }
        }
    }

    /// Takes so many of the last steps, each from its head on, out of those that wait.
    fn hold(&mut self, held: Held) -> Vec<Vec<Strip>> {
        let (Held::Back(count) | Held::Apart(count)) = held;
        let begins = |chunk: &Vec<Strip>| chunk.first().is_some_and(|strip| strip.group.class == "step-head");
        let heads: Vec<usize> =
            (0..self.waiting.len()).filter(|chunk| begins(&self.waiting[*chunk])).collect();
        let from = count.checked_sub(1).and_then(|before| heads.len().checked_sub(before + 1));
        from.map(|head| self.waiting.split_off(heads[head])).unwrap_or_default()
    }

    /// By how much the pages are blanker than a reader takes for full, in pages; the last one may end where it will, but not
    /// with some lines. Of a single page nothing is lost.
    fn blank_of_pages(&self) -> f64 {
        if self.ends.is_empty() {
            return 0.0;
        }
        let height = self.bottom() - MARGIN;
        let left = |end: &f64| ((self.bottom() - end) / height - MOST_BLANK).max(0.0);
        let last = (LEAST_LAST - (self.y - MARGIN) / self.paper.1).max(0.0);
        let torn = if self.torn { LINES_OF_A_STEP } else { 0.0 };
        self.ends.iter().map(left).sum::<f64>() + last + torn
    }

    /// Whether it has fewer pages, or as many and clearly less blank on them.
    fn better_than(&self, other: &Self) -> bool {
        /// What is worth another order of the page, in pages.
        const CLEARLY: f64 = 0.04;
        match self.pages.len().cmp(&other.pages.len()) {
            Ordering::Less => true,
            Ordering::Equal => self.blank_of_pages() + CLEARLY < other.blank_of_pages(),
            Ordering::Greater => false,
        }
    }

    /// As many of the steps as the page still takes, in columns; of the last ones even ones. Whether any.
    fn columns(&mut self) -> bool {
        let (width, count) = (self.column(), self.column_count());
        let free = self.bottom() - self.y;
        // On an empty page stands even what is too tall for any.
        let empty = self.y <= MARGIN + 8.0;
        let mut waiting = std::mem::take(&mut self.waiting);
        let chunks: Vec<Chunk> = waiting.iter().map(|strips| Chunk::of(strips)).collect();
        let columns = even_split(&chunks, free, empty, count);
        self.waiting = waiting.split_off(columns.iter().sum());
        let top = self.y;
        let first = waiting.first().and_then(|strips| strips.first());
        let lines: usize = waiting.iter().map(Vec::len).sum();
        if let Some(first) = first {
            self.torn = first.group.class != "step-head" && lines <= MOST_TORN;
        }
        let mut waiting = waiting.iter();
        for (column, own) in columns.iter().enumerate() {
            let x = MARGIN + column as f64 * (width + GUTTER);
            let mut y = top;
            for strip in waiting.by_ref().take(*own).flatten() {
                let lift = if y == top { strip.blank } else { 0.0 };
                self.add(strip.group.clone(), self.indented(x, width), y - lift);
                y += strip.height - lift;
            }
            self.y = self.y.max(y);
        }
        columns.iter().any(|own| *own > 0)
    }

    /// Running title and page number, and the pages below each other.
    fn finish(mut self) -> (Group, usize) {
        let count = self.pages.len();
        let mut root = Group::new("sheet");
        let pages = std::mem::take(&mut self.pages);
        for (i, mut page) in pages.into_iter().enumerate() {
            page = page.data("page", (i + 1).to_string());
            let number = Rich::fill(
                self.words.page,
                &[
                    ("page", Rich::upright(self.words.count(i + 1))),
                    ("pages", Rich::upright(self.words.count(count))),
                ],
            );
            let line = number.set(3.0);
            let far = self.paper.0 - MARGIN - line.width;
            let at = Point::new(self.indented(far, line.width), self.paper.1 - 10.0);
            line.put(&mut page, at, "page-number");
            if i > 0 {
                let title = Rich::written(&self.title, Face::Italic);
                let lines = title.wrap(3.2, self.width() - 4.0);
                if let Some(first) = lines.first() {
                    // What goes on is on the first page.
                    let line = if lines.len() > 1 { first.clone().up("\u{a0}…") } else { first.clone() };
                    let line = line.set(3.2);
                    let at = Point::new(self.indented(MARGIN, line.width), MARGIN - 3.0);
                    line.put(&mut page, at, "running-title");
                }
                // Arabic letters reach further down.
                let y = MARGIN - if self.words.right_to_left { 0.2 } else { 0.8 };
                let rule = Shape::Line(Point::new(MARGIN, y), Point::new(self.paper.0 - MARGIN, y));
                page.mark(Mark::stroke(rule, Pen::solid(0.18)).class("rule"));
            }
            page.translate(Vec2::new(0.0, i as f64 * self.paper.1));
            root.group(page);
        }
        (root, count)
    }
}
