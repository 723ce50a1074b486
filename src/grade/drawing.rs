//! A student's drawing as the SVG of a vector editor: its points are found by the letters beside them.
//!
//! Letters and marks are matched one to one, so that the letters in all lie as near to their marks as they can: a dot
//! rather than a place where lines end, that rather than the end of one line. Whatever leaves a choice (a mark that two
//! letters claim, two marks as near, none within reach) is told, never guessed, and leaves open what that letter names and
//! nothing else. Which figure a letter belongs to is told
//! by the layer (an `id`, class or label that holds `velocity`, `acceleration` or `skeleton`), and without layers by its
//! spelling: *A* is a joint, *a* a velocity image, *a′* an acceleration image.
//!
//! A figure of one of this program's own sheets or pages names its points itself, and its scale.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use kurbo::{Affine, Point};
use roxmltree::{Document, Node, ParsingOptions};

use super::answers::{Answers, FigurePoints};
use super::assign::assign;
use super::is_prime;
use super::nearest::Nearest;
use super::svg::{
    FONT_SIZE_PX, corners, first_length, font_size, length, points as corners_of, still, style, to_mm,
    transform,
};
use super::weight::weigh;
use crate::limits;
use crate::mechanism::quantity::Order;
use crate::scene::Scene;
use crate::scene::diagnostic::{Fault, Res};

/// A letter belongs to what lies within this many times its height.
const REACH: f64 = 2.5;

/// A mark may lie so much farther off (in heights of the letter) if it is a dot and not where lines end: around a joint
/// are hatchings and guides, and whoever draws a dot means it. A dot of another letter is kept for that one.
const DOT_RANK: f64 = REACH;

/// The same for a place where several lines end against the end of one.
const END_RANK: f64 = 0.35;

/// A leader ends so near to the middle of its letter, in heights of the letter.
const TIED: f64 = 1.2;

/// Two ways to read the letters that differ by less than this (in heights of a letter) are two ways.
const DOUBT: f64 = 0.1;

/// Marks that lie nearer to each other (mm) are one.
const SAME_MARK: f64 = 0.3;

/// Dots whose middles lie nearer (mm) were drawn about one another.
const ONE_DOT: f64 = 0.01;

/// Ends of lines that a careful hand leaves apart (mm), each a fifth of a millimetre off in both directions: one letter
/// beside them names their middle.
const PENCIL: f64 = 0.6;

/// A closed figure of three or four corners that is not larger than this (mm) is an arrowhead.
const ARROWHEAD: f64 = 6.0;

/// So many marks beside a letter are looked at.
const CANDIDATES: usize = 12;

/// A letter of the drawing.
struct Letter {
    /// As the text names its point; several where it says so, as in "b, c".
    names: Vec<String>,
    order: Order,
    /// A joint's letter in the layer of a polygon.
    capital: bool,
    /// The middle of its ink, about.
    middle: Point,
    /// Millimetres.
    height: f64,
    at: usize,
}

/// What a letter may name; millimetres, y down.
#[derive(Default)]
struct Marks {
    dots: Vec<Point>,
    ends: Vec<Point>,
    /// Tips of arrowheads, and how far these reach back.
    tips: Vec<(Point, f64)>,
    /// Lines that tie a letter to its mark; they mark nothing themselves.
    leaders: Vec<[Point; 2]>,
}

/// One place that letters may name.
#[derive(Clone, Copy)]
struct Mark {
    at: Point,
    /// It has a dot.
    dot: bool,
    /// So many dots stand there each in a place of its own, if by a hair.
    dots: usize,
    /// So many lines end or bend here.
    lines: usize,
}

/// Reads the points of a drawing into the answers.
pub(super) fn read(svg: &str, scene: &Scene, mut answers: Answers) -> Res<Answers> {
    let Drawing { figures, open } = points(svg, scene)?;
    for (figure, scale) in figures {
        answers.scales.tell(figure.order, scale);
        answers.figures.push(figure);
    }
    for (name, fault) in open {
        answers.miss(&name, None, fault);
    }
    Ok(answers)
}

/// The points of a figure, and its scale in SI units per millimetre where it says that itself.
pub(super) type Figure = (FigurePoints, Option<f64>);

/// What a drawing shows.
pub(super) struct Drawing {
    /// The points by figure, millimetres, y up.
    pub(super) figures: Vec<Figure>,
    /// The letters whose marks nobody can tell, with their figure (`velocity:b`).
    pub(super) open: Vec<(String, Fault)>,
}

/// The points of a drawing.
pub(super) fn points(svg: &str, scene: &Scene) -> Res<Drawing> {
    weigh(svg)?;
    // A vector editor declares the addresses of its namespaces in the document type; nothing that it names is opened.
    let options = ParsingOptions { allow_dtd: true, ..ParsingOptions::default() };
    let document = Document::parse_with_options(svg, options).map_err(|error| {
        let place = error.pos();
        let row = (place.row as usize).saturating_sub(1);
        let line: usize = svg.split_inclusive('\n').take(row).map(str::len).sum();
        Fault::new(line + (place.col as usize).saturating_sub(1), format!("not an SVG: {error}"))
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(Fault::new(root.range().start, "neither JSON, nor a table, nor an SVG"));
    }
    let (marks, mut letters, own) = read_all(root, &Names::new(scene))?;
    // Whoever letters his polygon A, B means its images; beside small letters capitals are remarks.
    let small: Vec<Order> = letters
        .iter()
        .filter(|letter| !letter.capital && letter.names.iter().any(|name| name != "o"))
        .map(|letter| letter.order)
        .collect();
    letters.retain(|letter| !letter.capital || !small.contains(&letter.order));
    let leaders = marks.leaders.clone();
    let marks = marks.gathered();
    let mut figures: Vec<Figure> = own.into_iter().map(|own| (own.points, Some(own.si_per_mm))).collect();
    // What is written beside a figure that names its points (on free bodies, in the steps) is no second one.
    letters.retain(|letter| !figures.iter().any(|(figure, _)| figure.order == letter.order));
    let mut named: HashMap<(usize, String), [f64; 2]> = HashMap::new();
    let mut shared: Vec<(usize, String, String)> = Vec::new();
    let (found, doubtful) = matched(letters, &marks, &leaders);
    let mut open: Vec<(String, Fault)> = Vec::new();
    let in_figure = |order: Order, name: &str| format!("{}:{name}", super::case::figure_name(order));
    for (letter, fault) in doubtful {
        open.extend(letter.names.iter().map(|name| (in_figure(letter.order, name), fault.clone())));
    }
    let mut twice: HashSet<(usize, String)> = HashSet::new();
    for (letter, (mark, rival)) in found {
        let place = [mark.x, -mark.y];
        let index = figures.iter().position(|(f, _)| f.order == letter.order).unwrap_or_else(|| {
            let figure = FigurePoints { order: letter.order, points: Vec::new(), shared: Vec::new() };
            figures.push((figure, None));
            figures.len() - 1
        });
        shared.extend(rival.map(|rival| (index, letter.text().to_owned(), rival)));
        for name in letter.names {
            match named.entry((index, name)) {
                Entry::Vacant(free) => {
                    figures[index].0.points.push((free.key().1.clone(), place, letter.at));
                    free.insert(place);
                }
                Entry::Occupied(taken) if *taken.get() != place => {
                    if twice.insert(taken.key().clone()) {
                        let name = &taken.key().1;
                        let fault = Fault::new(letter.at, format!("`{name}` names two points"));
                        let mend = "keep one of the two, or tell the figures apart by layers";
                        open.push((in_figure(letter.order, name), fault.mend(mend)));
                    }
                }
                Entry::Occupied(_) => {}
            }
        }
    }
    // Which of the two is meant, nobody knows.
    for (index, name) in &twice {
        figures[*index].0.points.retain(|(known, ..)| known != name);
    }
    for (index, one, other) in shared {
        let points = &figures[index].0.points;
        let of = |name: &str| points.iter().position(|(known, ..)| known == name);
        if let (Some(one), Some(other)) = (of(&one), of(&other)) {
            figures[index].0.shared.push([one, other]);
        }
    }
    figures.retain(|(figure, _)| !figure.points.is_empty());
    if figures.is_empty() {
        if let Some((_, fault)) = open.into_iter().next() {
            return Err(fault);
        }
        let fault = Fault::new(root.range().start, "no letter of this drawing names a point of the scene");
        return Err(fault.mend("write A at a joint, a at its velocity image, a′ at its acceleration image, o and o′ at the poles"));
    }
    Ok(Drawing { figures, open })
}

/// A mark, and the other letter that names it too, where there is one.
type Named = (Point, Option<String>);

/// A letter whose mark nobody can tell, and why.
type Open = (Letter, Fault);

/// The letters with their marks, and those whose mark nobody can tell.
fn matched(
    letters: Vec<Letter>,
    marks: &[Mark],
    leaders: &[[Point; 2]],
) -> (Vec<(Letter, Named)>, Vec<Open>) {
    let places: Vec<Point> = marks.iter().map(|mark| mark.at).collect();
    let nearest = Nearest::new(&places);
    // In heights of the letter, the nearest first.
    let claims = |letter: &Letter| -> Vec<(usize, f64)> {
        let reach = REACH * letter.height;
        let tied = leaders.iter().flat_map(|[p, q]| [[*p, *q], [*q, *p]]);
        let tied = tied.filter(|[from, _]| from.distance(letter.middle) <= TIED * letter.height);
        // What a leader ties a letter to is nearest to it, however far.
        let tied: HashSet<usize> =
            tied.flat_map(|[_, to]| nearest.within(to, SAME_MARK, 1)).map(|(mark, _)| mark).collect();
        let cost = |(mark, far): (usize, f64)| {
            let rank = if marks[mark].dot {
                0.0
            } else if marks[mark].lines > 1 {
                DOT_RANK
            } else {
                DOT_RANK + END_RANK
            };
            (mark, far / letter.height + rank)
        };
        let free = nearest.within(letter.middle, reach, CANDIDATES).into_iter().map(cost);
        let free = free.filter(|(mark, _)| !tied.contains(mark));
        let mut claims: Vec<(usize, f64)> = free.chain(tied.iter().map(|mark| (*mark, 0.0))).collect();
        claims.sort_by(|a, b| a.1.total_cmp(&b.1).then(a.0.cmp(&b.0)));
        claims
    };
    let mut open: Vec<Open> = Vec::new();
    let (mut near, mut costs): (Vec<Letter>, Vec<Vec<(usize, f64)>>) = (Vec::new(), Vec::new());
    // The same letter twice beside one mark is written twice, and names one point.
    let mut kept: HashSet<(u8, Vec<String>, usize)> = HashSet::new();
    for letter in letters {
        let claims = claims(&letter);
        let Some(&(mark, _)) = claims.first() else {
            let what = format!("nothing is marked beside the letter `{}`", letter.text());
            let fault = Fault::new(letter.at, what);
            open.push((letter, fault.mend("set it nearer to its dot or to the end of its line")));
            continue;
        };
        if kept.insert((letter.order as u8, letter.names.clone(), mark)) {
            near.push(letter);
            costs.push(claims);
        }
    }
    let letters = near;
    let given = assign(&costs);
    let cost = |letter: usize, mark: usize| -> Option<f64> {
        costs[letter].iter().find(|(known, _)| *known == mark).map(|(_, cost)| *cost)
    };
    let owner: HashMap<usize, usize> = given.iter().zip(0..).filter_map(|(m, i)| Some(((*m)?, i))).collect();
    let beside = |index: usize, mark: Option<usize>| -> Res<Named> {
        let letter = &letters[index];
        let Some(mark) = mark else {
            // Two letters beside one mark: whether they may be one point is seen by the right solution.
            let nearest = costs[index].first().and_then(|(mark, _)| Some((*mark, *owner.get(mark)?)));
            let Some((mark, rival)) = nearest.filter(|(_, rival)| letters[*rival].order == letter.order)
            else {
                let what = format!("`{}` stands beside a mark of another letter", letter.text());
                return Err(Fault::new(letter.at, what).mend("give each a dot of its own"));
            };
            // As many dots as letters: which of them is whose makes no difference.
            let beside_it = costs.iter().filter(|own| own.first().is_some_and(|(near, _)| *near == mark));
            if beside_it.count() <= marks[mark].dots {
                return Ok((marks[mark].at, None));
            }
            return Ok((marks[mark].at, Some(letters[rival].text().to_owned())));
        };
        let own = cost(index, mark).unwrap_or(0.0);
        // What nobody else claims so near to it is the same point, drawn twice.
        let one_point: Vec<Point> = costs[index]
            .iter()
            .filter(|(other, _)| *other == mark || !owner.contains_key(other))
            .map(|(other, _)| marks[*other])
            .filter(|other| !other.dot && other.at.distance(marks[mark].at) <= PENCIL)
            .map(|other| other.at)
            .collect();
        let among = |other: usize| one_point.contains(&marks[other].at);
        for &(other, else_cost) in costs[index].iter().filter(|(other, _)| *other != mark && !among(*other)) {
            let apart = match owner.get(&other) {
                // Another letter would have to go where this one stands.
                Some(&rival) => cost(rival, mark).zip(cost(rival, other)).map(|(there, here)| there - here),
                None => Some(0.0),
            };
            let doubtful = apart.is_some_and(|apart| else_cost - own + apart < DOUBT);
            if doubtful {
                let what = format!("`{}` stands as near to one mark as to another", letter.text());
                return Err(Fault::new(letter.at, what).mend("set it nearer to its own, or draw a dot there"));
            }
        }
        let middle = match (marks[mark].dot, one_point.len()) {
            (false, count) if count > 1 => {
                one_point.iter().fold(Point::ZERO, |sum, at| sum + at.to_vec2() / count as f64)
            }
            _ => marks[mark].at,
        };
        Ok((middle, None))
    };
    let named: Vec<Res<Named>> = given.iter().enumerate().map(|(index, mark)| beside(index, *mark)).collect();
    let mut found = Vec::new();
    for (letter, named) in letters.into_iter().zip(named) {
        match named {
            Ok(named) => found.push((letter, named)),
            Err(fault) => open.push((letter, fault)),
        }
    }
    (found, open)
}

impl Letter {
    fn text(&self) -> &str {
        self.names.first().map_or("", String::as_str)
    }
}

impl Marks {
    /// The marks, each place once: what lies together is one, and the lines that end at an arrowhead end at its tip.
    fn gathered(self) -> Vec<Mark> {
        let tips: Vec<Point> = self.tips.iter().map(|(at, _)| *at).collect();
        let farthest = self.tips.iter().map(|(_, back)| *back).fold(0.0, f64::max);
        let nearest = Nearest::new(&tips);
        let at_tip = |end: Point| {
            let near = nearest.within(end, farthest, CANDIDATES);
            near.into_iter().find(|(tip, far)| *far <= self.tips[*tip].1).map_or(end, |(tip, _)| tips[tip])
        };
        let dots = self.dots.iter().map(|at| (*at, true));
        let ends = self.ends.iter().map(|at| (at_tip(*at), false));
        let mut marks: Vec<Mark> = Vec::new();
        let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
        for (at, dot) in dots.chain(tips.iter().map(|at| (*at, false))).chain(ends) {
            #[expect(clippy::cast_possible_truncation, reason = "what is on paper is small")]
            let cell = ((at.x / SAME_MARK).floor() as i64, (at.y / SAME_MARK).floor() as i64);
            let around = (-1..=1).flat_map(|x| (-1..=1).map(move |y| (cell.0 + x, cell.1 + y)));
            let near = around.filter_map(|cell| cells.get(&cell)).flatten().copied();
            let one = near.into_iter().find(|&known| marks[known].at.distance(at) <= SAME_MARK);
            let index = one.unwrap_or_else(|| {
                cells.entry(cell).or_default().push(marks.len());
                marks.push(Mark { at, dot: false, dots: 0, lines: 0 });
                marks.len() - 1
            });
            // A ring about a dot is one with it.
            let apart = marks[index].dots == 0 || marks[index].at.distance(at) > ONE_DOT;
            marks[index].dots += usize::from(dot && apart);
            marks[index].dot |= dot;
            marks[index].lines += usize::from(!dot);
        }
        marks
    }
}

/// The names of a scene's points.
struct Names<'s> {
    points: HashSet<&'s str>,
    /// In small letters, as images are named.
    images: HashSet<String>,
    /// The same of fixed points alone: their images are the pole.
    poles: HashSet<String>,
}

impl<'s> Names<'s> {
    fn new(scene: &'s Scene) -> Self {
        let points = || scene.mechanism.points.iter().map(|p| p.name.as_str());
        let mechanism = &scene.mechanism;
        let fixed = |p: &&crate::mechanism::Point| matches!(p.place, crate::mechanism::Place::Fixed(_));
        let names = |fixed_ones: bool| -> HashSet<String> {
            let all = mechanism.points.iter().filter(|p| fixed(p) == fixed_ones);
            all.map(|p| p.name.to_lowercase()).collect()
        };
        let moving = names(false);
        let poles = names(true).into_iter().filter(|name| !moving.contains(name)).collect();
        Self { points: points().collect(), images: points().map(str::to_lowercase).collect(), poles }
    }
}

/// What an element takes over from those around it.
#[derive(Debug, Clone, Copy)]
struct Around {
    onto: Affine,
    layer: Option<Order>,
    /// User units.
    font_size: f64,
    anchor: Anchor,
    /// By `visibility`, which what stands inside may take back.
    hidden: bool,
}

/// Where a text begins.
#[derive(Debug, Clone, Copy)]
enum Anchor {
    Start,
    Middle,
    End,
}

impl Around {
    /// For what stands in an element.
    fn within(self, node: Node<'_, '_>) -> Res<Self> {
        Ok(Self {
            onto: self.onto * transform(node)?,
            layer: layer(node).or(self.layer),
            font_size: font_size(node, self.font_size).unwrap_or(self.font_size),
            anchor: anchor(node).unwrap_or(self.anchor),
            hidden: style(node, "visibility").map_or(self.hidden, |said| said.trim() != "visible"),
        })
    }
}

/// Elements of which nothing is drawn where they stand.
const NOT_DRAWN: [&str; 9] =
    ["defs", "marker", "symbol", "clipPath", "mask", "pattern", "metadata", "title", "desc"];

/// A figure that names its points itself.
struct Own {
    points: FigurePoints,
    si_per_mm: f64,
}

impl Own {
    /// What a sheet of this program says of a figure: which it is, and its scale.
    fn begun(node: Node<'_, '_>) -> Option<Self> {
        let scale = node.attribute("data-si-per-mm")?.parse::<f64>().ok();
        let si_per_mm = scale.filter(|scale| scale.is_finite() && *scale > 0.0)?;
        let points = FigurePoints { order: layer(node)?, points: Vec::new(), shared: Vec::new() };
        Some(Self { points, si_per_mm })
    }

    /// The points that stand in a figure: each a group that says its name, with a dot or a ring.
    fn find(&mut self, figure: Node<'_, '_>, around: Around, names: &Names<'_>) -> Res<()> {
        let mut open = vec![(figure, around)];
        while let Some((node, around)) = open.pop() {
            if ["joint", "image"].iter().any(|class| is_of(node, class)) {
                self.take(node, around, names)?;
                continue;
            }
            for child in node.children().filter(|child| child.tag_name().name() == "g") {
                if !is_of(child, "detail") {
                    open.push((child, around.within(child)?));
                }
            }
        }
        Ok(())
    }

    fn take(&mut self, node: Node<'_, '_>, around: Around, names: &Names<'_>) -> Res<()> {
        let pole = is_of(node, "pole").then_some("o");
        let said = node.attribute("data-point").or(pole);
        let ring = node.children().find(|child| child.tag_name().name() == "circle");
        let (Some(said), Some(ring), false) = (said, ring, around.hidden) else { return Ok(()) };
        let Some((name, _)) = named(&plain(said, names), Some(self.points.order), names) else {
            return Ok(());
        };
        let within = around.within(ring)?;
        let [x, y] = [length(ring, "cx")?, length(ring, "cy")?].map(Option::unwrap_or_default);
        let at = within.onto * Point::new(x, y);
        let is_known = self.points.points.iter().any(|(known, ..)| *known == name);
        if at.is_finite() && !within.hidden && !is_known {
            self.points.points.push((name, [at.x, -at.y], node.range().start));
        }
        Ok(())
    }
}

/// All marks, the letters that name points, and the figures that name their points themselves.
fn read_all(root: Node<'_, '_>, names: &Names<'_>) -> Res<(Marks, Vec<Letter>, Vec<Own>)> {
    let (mut marks, mut letters) = (Marks::default(), Vec::new());
    let mut own: Vec<Own> = Vec::new();
    let page = Around {
        onto: to_mm(root)?,
        layer: None,
        font_size: FONT_SIZE_PX,
        anchor: Anchor::Start,
        hidden: false,
    };
    // The next is the last: an element before its children, those in their order.
    let mut open = vec![(root, page)];
    while let Some((node, around)) = open.pop() {
        // What stands here is drawn elsewhere, or nowhere.
        let unseen = style(node, "display").is_some_and(|shown| shown.trim() == "none");
        if unseen || NOT_DRAWN.contains(&node.tag_name().name()) {
            for sheet in node.descendants().filter(|inner| inner.tag_name().name() == "style") {
                still(sheet)?;
            }
            continue;
        }
        let around = around.within(node)?;
        if let Some(mut figure) = Own::begun(node) {
            figure.find(node, around, names)?;
            // Of a figure that stands twice, as in a sheet of steps, the last is the whole one.
            if !figure.points.points.is_empty() {
                own.retain(|known| known.points.order != figure.points.order);
                own.push(figure);
                continue;
            }
        }
        match node.tag_name().name() {
            "style" => still(node)?,
            _ if around.hidden => {}
            "text" => {
                letters.extend(letter(node, around, names)?);
                if letters.len() > limits::LETTERS {
                    let most = limits::grouped(limits::LETTERS);
                    let fault =
                        Fault::new(node.range().start, format!("more than {most} letters that name points"));
                    return Err(fault);
                }
            }
            _ => marks.add(node, around.onto)?,
        }
        if marks.dots.len() + marks.ends.len() > limits::MARKS {
            let most = limits::grouped(limits::MARKS);
            let what = format!("more than {most} dots, corners and ends of lines");
            return Err(Fault::new(node.range().start, what).mend("hand in the drawing alone"));
        }
        // What is shown once more, enlarged, marks nothing; the letters of running text on a sheet name nothing.
        let marks_nothing = |child: &Node<'_, '_>| is_of(*child, "detail") || is_running_text(*child);
        let children = node.children().rev().filter(|child| child.is_element() && !marks_nothing(child));
        open.extend(children.map(|child| (child, around)));
    }
    Ok((marks, letters, own))
}

/// Groups of a sheet that hold lines of text.
const RUNNING_TEXT: [&str; 5] = ["given", "heading", "caption", "sentence", "page-number"];

/// Whether an element is a line of text on a sheet; one that runs from right to left is broken up into texts of its own.
fn is_running_text(node: Node<'_, '_>) -> bool {
    let arabic = |child: Node<'_, '_>| child.tag_name().name() == "text" && is_of(child, "arabic");
    node.tag_name().name() == "g"
        && (RUNNING_TEXT.iter().any(|class| is_of(node, class)) || node.children().any(arabic))
}

/// Whether an element says to be of a class.
fn is_of(node: Node<'_, '_>, class: &str) -> bool {
    node.attribute("class").is_some_and(|all| all.split_whitespace().any(|own| own == class))
}

impl Marks {
    /// What an element marks.
    fn add(&mut self, node: Node<'_, '_>, onto: Affine) -> Res<()> {
        let number = |name: &str| length(node, name).map(Option::unwrap_or_default);
        let place = |at: Point| {
            let place = onto * at;
            // What is on no paper is not drawn.
            (place.x.abs() <= limits::PAPER_MM && place.y.abs() <= limits::PAPER_MM).then_some(place)
        };
        match node.tag_name().name() {
            "circle" | "ellipse" => self.dots.extend(place(Point::new(number("cx")?, number("cy")?))),
            "line" => {
                self.ends.extend(place(Point::new(number("x1")?, number("y1")?)));
                self.ends.extend(place(Point::new(number("x2")?, number("y2")?)));
            }
            "polyline" | "polygon" => {
                let corners = corners_of(node)?.into_iter().filter_map(place).collect();
                self.add_corners(corners, node.tag_name().name() == "polygon");
            }
            "path" => {
                let closed = node.attribute("d").is_some_and(|path| path.contains(['z', 'Z']));
                let corners: Vec<Point> = corners(node)?.into_iter().filter_map(place).collect();
                match corners[..] {
                    [from, to] if is_of(node, "leader") => self.leaders.push([from, to]),
                    _ => self.add_corners(corners, closed),
                }
            }
            _ => {}
        }
        Ok(())
    }
}

impl Marks {
    /// Corners of a line or of a closed figure; of an arrowhead its tip alone.
    fn add_corners(&mut self, corners: Vec<Point>, closed: bool) {
        let middle = corners.iter().fold(Point::ZERO, |sum, p| sum + p.to_vec2() / corners.len() as f64);
        let far = |p: &&Point| p.distance(middle);
        let extent =
            corners.iter().flat_map(|p| corners.iter().map(|q| p.distance(*q))).take(64).fold(0.0, f64::max);
        let tip = corners.iter().max_by(|p, q| far(p).total_cmp(&far(q)));
        match tip {
            Some(&tip) if closed && matches!(corners.len(), 3..=5) && extent <= ARROWHEAD => {
                self.tips.push((tip, 1.1 * extent));
            }
            _ => self.ends.extend(corners),
        }
    }
}

/// A text that names a point of the scene; all other texts are captions and the like.
fn letter(text: Node<'_, '_>, around: Around, names: &Names<'_>) -> Res<Option<Letter>> {
    let written: String = text.descendants().filter(Node::is_text).filter_map(|n| n.text()).collect();
    let whole = plain(&written, names);
    // One text may name several points that are one: "b, c". An index like that of b′1,2 is none of them.
    let several: Vec<&str> = whole.split(',').collect();
    let read: Option<Vec<(String, Order)>> =
        several.iter().map(|part| named(part, around.layer, names)).collect();
    let as_capital = || {
        let image = around.layer.filter(|layer| *layer != Order::Position)?;
        let of_joint = names.points.contains(whole.as_str()) || whole == "O";
        of_joint.then(|| named(&whole.to_lowercase(), Some(image), names))?
    };
    let mut capital = false;
    let read = match read {
        Some(read) if several.len() > 1 => read,
        _ => match named(&whole, around.layer, names) {
            Some(read) => vec![read],
            None => match as_capital() {
                Some(read) => {
                    capital = true;
                    vec![read]
                }
                None => return Ok(None),
            },
        },
    };
    let Some(order) = read.first().map(|(_, order)| *order) else { return Ok(None) };
    if read.iter().any(|(_, other)| *other != order) {
        return Ok(None);
    }
    let positioned = |node: &Node<'_, '_>| node.attribute("x").is_some() && node.attribute("y").is_some();
    let place = text.descendants().find(positioned).unwrap_or(text);
    let [x, y] = [first_length(place, "x")?, first_length(place, "y")?].map(Option::unwrap_or_default);
    // The innermost size that is said; a part of the size around is one of what stands around it.
    let inside = || place.ancestors().take_while(|node| *node != text);
    let from_outside: Vec<Node<'_, '_>> = inside().collect();
    let sized = |size: f64, node: &Node<'_, '_>| font_size(*node, size).unwrap_or(size);
    let size = from_outside.iter().rev().fold(around.font_size, sized);
    // Letters are about half as wide as high, their ink about two thirds of the height of the font.
    let width = 0.5 * size * whole.chars().count() as f64;
    let before = match inside().find_map(anchor).unwrap_or(around.anchor) {
        Anchor::Middle => 0.0,
        Anchor::End => -0.5,
        Anchor::Start => 0.5,
    };
    let middle = around.onto * Point::new(x + before * width, y - 0.33 * size);
    let height = size * around.onto.determinant().abs().sqrt();
    let seen = middle.is_finite() && height.is_finite() && height > 0.0;
    Ok(seen.then(|| Letter {
        names: read.into_iter().map(|(name, _)| name).collect(),
        order,
        capital,
        middle,
        height,
        at: text.range().start,
    }))
}

/// A text without spaces, with the indices that sheets print, or hands type, as they are named: a₂ and a_2 are a2.
fn plain(written: &str, names: &Names<'_>) -> String {
    let index = |letter: char| match letter {
        '₀'..='₉' => char::from_digit(letter as u32 - '₀' as u32, 10).unwrap_or(letter),
        other => other,
    };
    let joins = |letter: char| letter == '_' && !names.images.iter().any(|name| name.contains('_'));
    written.chars().filter(|letter| !letter.is_whitespace() && !joins(*letter)).map(index).collect()
}

/// The point that a text names, and in which figure: by the layer, or by its spelling.
fn named(name: &str, layer: Option<Order>, names: &Names<'_>) -> Option<(String, Order)> {
    let bare: String = name.chars().filter(|c| !is_prime(*c) && *c != ',').collect();
    let letters = bare.trim_end_matches(|c: char| c.is_ascii_digit());
    let is_image = letters == "o" || names.images.contains(letters) || names.images.contains(&bare);
    let by_spelling = if names.points.contains(name) && name.contains(char::is_uppercase) {
        Some(Order::Position)
    } else if !is_image {
        None
    } else if name.contains(is_prime) {
        Some(Order::Acceleration)
    } else {
        Some(Order::Velocity)
    };
    let order = match (layer, by_spelling?) {
        // An image in the layer of its polygon may go without its prime; a joint's name there is none of its points.
        (Some(layer), Order::Position) if layer != Order::Position => return None,
        (Some(layer), _) => layer,
        (None, spelled) => spelled,
    };
    // What stands still has its image in the pole.
    let pole = order != Order::Position && (bare == "o" || names.poles.contains(&bare));
    Some((if pole { "o".to_owned() } else { name.to_owned() }, order))
}

/// The figure that a layer says to hold.
fn layer(node: Node<'_, '_>) -> Option<Order> {
    let named = node.attributes().filter(|a| matches!(a.name(), "id" | "class" | "label"));
    named.into_iter().find_map(|attribute| {
        let said = attribute.value().to_lowercase();
        let orders = [
            ("velocity", Order::Velocity),
            ("acceleration", Order::Acceleration),
            ("skeleton", Order::Position),
        ];
        orders.into_iter().find_map(|(word, order)| said.contains(word).then_some(order))
    })
}

/// Where an element says its text to begin.
fn anchor(node: Node<'_, '_>) -> Option<Anchor> {
    style(node, "text-anchor").map(|said| match said.as_str() {
        "middle" => Anchor::Middle,
        "end" => Anchor::End,
        _ => Anchor::Start,
    })
}
