//! Label placement: candidates with costs, a greedy pass in a fixed order, then repair passes.
//!
//! What a place costs is found out as far as it matters: a place that touches ink is not counted to the end before
//! no free one is left, and a label is looked at again only when something within its reach has moved.

use std::cell::RefCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::{ControlFlow, Range};

use kurbo::{Point, Rect, Vec2};

use super::figure::{Group, Life, Mark, Node, Pen, Shape, Tone};
use super::grid::{Grid, Met};
use super::overlap::clip;
use super::rich::{Line, Rich};

/// Clear space kept around a label.
const CLEARANCE: f64 = 0.55;
/// A blank between words: labels beside each other keep more than that.
const WORD: f64 = 1.6;
/// Cost of touching ink or another label: more than any preference.
const TOUCH: f64 = 1000.0;
/// Cost of standing nearer to another named point: more than a leader that crosses two lines.
const MISREAD: f64 = 75.0;
/// Cost of standing beyond another line than those that end in a point: more than a leader.
const ACROSS: f64 = 45.0;
/// What else is named is this much further away than what a name names, or the name might be its.
const BESIDE: f64 = 1.0;
/// Names reach into each other by no more than this.
const INTO: f64 = 0.2;
/// Lines no further apart than this are named side by side.
const TOGETHER: f64 = 0.8;
/// A name that stands by so much nearer to something else than to its own is that one's.
const NEARER: f64 = 0.2;
/// A leader passes other points, and ends beside other lines, no nearer than this.
const PASSING: f64 = 0.5;
/// Passes of repair; each label moves to its best place given all others.
const PASSES: usize = 8;
/// Moves by which a crowd is untangled: where so many do not suffice there is no room.
const MOVES: usize = 1500;
/// Places that are looked at while a crowd is untangled, beyond which it is past repair: a sheet has an end, however
/// many names crowd on it.
const LOOKS: usize = 150_000;
/// More labels than this that touch something are past repair.
const MOST_TOUCHING: usize = 100;
/// More names than this within [`AROUND`] of a place, and there is no room for them.
const CROWD: usize = 40;
/// The paper around a place that its names share, mm: some twenty names fill it.
const AROUND: f64 = 15.0;

/// The data of a group of labels that tell for which names there was no room.
pub(super) const UNNAMED: &str = "unnamed";

/// Where a label may stand.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Site {
    /// Around a point, outside a disc of this radius.
    Around {
        /// The point.
        at: Point,
        /// What the point's own symbol covers.
        radius: f64,
        /// Preferred direction, radians counter-clockwise from the right, if any.
        toward: Option<f64>,
    },
    /// Beside a straight piece of ink.
    Along {
        /// One end.
        from: Point,
        /// Other end.
        to: Point,
    },
}

/// A label to be placed.
#[derive(Debug, Clone, PartialEq)]
pub struct Request {
    /// The text.
    pub text: Rich,
    /// Size of the type.
    pub size: f64,
    /// Where it may stand; the first is preferred.
    pub sites: Vec<Site>,
    /// Class of the text.
    pub class: &'static str,
    /// Radius of a circle around the text, for link numbers.
    pub ring: Option<f64>,
    /// Left out where no free place is found.
    pub optional: bool,
    /// May be tied to its point by a leader.
    pub leader: bool,
    /// What it names, as the `data-` attributes of that ink call it: told with the label, so that whoever reads the
    /// figure need not guess whose name it is.
    pub names: Vec<String>,
    /// When it came onto the paper.
    pub life: Option<Life>,
    /// It never stands nearer to something else that is named, nor behind it: where there is no such place a leader ties it.
    pub strict: bool,
    /// The stroke that it names, where it stands beside a piece of it only.
    pub stroke: Option<(Point, Point)>,
    /// The point to which a leader ties it wherever it stands.
    pub tie: Option<Point>,
    /// The names of which the text consists, where they came onto the paper one after the other; none where it is one.
    pub pieces: Vec<Piece>,
}

/// One of several names that stand beside each other, as `a` of `o,a`.
#[derive(Debug, Clone, PartialEq)]
pub struct Piece {
    /// The name, with what parts it from the one before it.
    pub text: Rich,
    /// What it names.
    pub names: Vec<String>,
    /// When it came onto the paper.
    pub life: Life,
}

/// The pieces of a name of things that fall together, in the order in which they came onto the paper; none where all came at
/// once. A separator stands between each two.
#[must_use]
pub fn pieces(names: Vec<(Rich, Vec<String>, Life)>, separator: &Rich) -> Vec<Piece> {
    let mut names = names;
    names.sort_by_key(|(.., life)| life.born);
    let mut all: Vec<(Vec<Rich>, Vec<String>, Life)> = Vec::new();
    for (text, of, life) in names {
        match all.last_mut().filter(|(.., own)| own.born == life.born) {
            Some((texts, own_names, own)) => {
                texts.push(text);
                own_names.extend(of);
                own.read = [own.read, life.read].into_iter().flatten().min();
            }
            None => all.push((vec![text], of, life)),
        }
    }
    if all.len() < 2 {
        return Vec::new();
    }
    let piece = |(k, (texts, names, life)): (usize, (Vec<Rich>, Vec<String>, Life))| {
        let text = Rich::join(&texts, separator);
        let text = if k == 0 { text } else { separator.clone().then(&text) };
        Piece { text, names, life }
    };
    all.into_iter().enumerate().map(piece).collect()
}

/// What stands among the names without asking for one here.
#[derive(Debug, Default)]
pub struct Others {
    /// Points.
    pub points: Vec<Point>,
    /// Strokes.
    pub lines: Vec<(Point, Point)>,
}

impl Request {
    /// The same with its life.
    #[must_use]
    pub fn lived(mut self, life: Option<impl Into<Life>>) -> Self {
        self.life = life.map(Into::into);
        self
    }

    /// The same as the name of that.
    #[must_use]
    pub fn naming(mut self, what: impl IntoIterator<Item = String>) -> Self {
        self.names.extend(what);
        self
    }

    /// The same with a further place where it may stand.
    #[must_use]
    pub fn or(mut self, site: Site) -> Self {
        self.sites.push(site);
        self
    }

    /// A label that must be placed.
    #[must_use]
    pub fn new(text: Rich, size: f64, site: Site, class: &'static str) -> Self {
        Self {
            text,
            size,
            sites: vec![site],
            class,
            ring: None,
            optional: false,
            leader: false,
            names: Vec::new(),
            life: None,
            pieces: Vec::new(),
            strict: false,
            stroke: None,
            tie: None,
        }
    }

    /// The same of names that came onto the paper one after the other, in that order.
    #[must_use]
    pub fn in_pieces(mut self, pieces: Vec<Piece>) -> Self {
        if let [first, others @ ..] = &pieces[..] {
            self.text = others.iter().fold(first.text.clone(), |text, piece| text.then(&piece.text));
        }
        self.pieces = pieces;
        self
    }
}

/// A place where a label may stand.
#[derive(Debug, Clone, Copy)]
struct Candidate {
    /// Of its ink.
    centre: Point,
    leader: Option<(Point, Point)>,
    /// Preference plus what the fixed ink costs; where `counted` is not set, at least as much.
    cost: f64,
    touches_ink: bool,
    counted: bool,
    /// The site that it belongs to.
    site: usize,
}

/// The body of a label, which all its candidates share.
struct Body {
    line: Line,
    /// Middle of its ink, from the start of the base line.
    middle: Vec2,
    /// Half its width and height.
    half: Vec2,
    /// Its boxes, from the start of the base line; one about the centre where it has a ring.
    boxes: Vec<Rect>,
    ringed: bool,
}

impl Body {
    fn new(request: &Request) -> Self {
        let line = request.text.set(request.size);
        let half = match request.ring {
            Some(radius) => Vec2::new(radius, radius),
            None => Vec2::new(line.ink.width() / 2.0, line.ink.height() / 2.0),
        };
        let (ringed, middle) = (request.ring.is_some(), line.ink.center().to_vec2());
        let boxes = if ringed {
            vec![Rect::from_center_size(Point::ZERO, (2.0 * half.x, 2.0 * half.y))]
        } else {
            let own = line.boxes_at(Point::ZERO);
            let blanks = blanks(&own, request.size);
            own.into_iter().chain(blanks).collect()
        };
        Self { line, middle, half, boxes, ringed }
    }

    /// The start of the base line where its centre stands here.
    fn start(&self, centre: Point) -> Point {
        centre - self.middle
    }

    /// Its boxes where its centre stands here.
    fn boxes(&self, centre: Point) -> impl Iterator<Item = Rect> + '_ {
        let by = if self.ringed { centre.to_vec2() } else { self.start(centre).to_vec2() };
        self.boxes.iter().map(move |own| *own + by)
    }
}

/// The blanks between the boxes of a line, as high as a small letter: a stroke through one strikes the line out.
fn blanks(boxes: &[Rect], size: f64) -> Vec<Rect> {
    /// Of its size a small letter is so high; and a wider blank parts two texts.
    const LETTER: f64 = 0.45;
    const WIDEST: f64 = 1.0;
    let mut all = boxes.to_vec();
    all.sort_by(|a, b| a.x0.total_cmp(&b.x0));
    let (mut blanks, mut end) = (Vec::new(), f64::INFINITY);
    for own in all {
        if own.x0 > end && own.x0 < end + WIDEST * size {
            blanks.push(Rect::new(end, -LETTER * size, own.x0, 0.0));
        }
        end = if end.is_finite() { end.max(own.x1) } else { own.x1 };
    }
    blanks
}

/// Ink that labels keep away from.
#[derive(Debug, Default)]
pub struct Obstacles {
    strokes: Vec<(Point, Point, f64)>,
    /// The strokes in their order, small things of many strokes as one.
    clumps: Vec<Clump>,
    areas: Vec<Area>,
    boxes: Vec<Rect>,
    /// Clumps, areas and boxes, in turn numbered by [`Kind`]: each kind may grow.
    grid: Grid,
    /// What comes later is entered in the grid as it stands.
    grows: bool,
    scratch: RefCell<Scratch>,
}

/// Strokes of one mark that lie together: the chords of a circle, the sides of an arrow's head. In a crowd hundreds of
/// such things lie on each other, and most labels ask for the box of each alone.
#[derive(Debug)]
struct Clump {
    strokes: Range<usize>,
    /// Other strokes that lie where its own do: in the polygon of a long chain hundreds fall together.
    copies: Vec<usize>,
    /// The box of their ink.
    bounds: Rect,
}

/// Filled outlines that lie on each other: the heads of the arrows that a long chain has in one place.
#[derive(Debug)]
struct Area {
    outlines: Vec<Vec<Point>>,
    /// The box of their corners.
    bounds: Rect,
}

/// Two points, in units of [`TOGETHER_MM`].
type Ends = ([i64; 2], [i64; 2]);

/// What labels keep away from.
enum Thing<'a> {
    Clump(&'a Clump),
    Area(&'a Area),
    /// Of this number.
    Box(usize),
}

/// The kinds of things in a grid: the number of a thing is its place among its kind, times their number, and the kind.
#[derive(Debug, Clone, Copy)]
enum Kind {
    Clump,
    Area,
    Box,
}

impl Kind {
    const COUNT: usize = 3;

    /// The number in the grid of the thing at this place.
    fn number(self, place: usize) -> usize {
        place * Self::COUNT + self as usize
    }
}

impl Area {
    /// How many of the outlines have a corner in a box.
    fn entered_by(&self, own: Rect) -> usize {
        self.outlines.iter().filter(|outline| outline.iter().any(|p| own.contains(*p))).count()
    }
}

impl Clump {
    /// All its strokes, by number.
    fn all(&self) -> impl Iterator<Item = usize> {
        self.strokes.clone().chain(self.copies.iter().copied())
    }
}

/// The box of these points.
fn around(points: &[Point]) -> Rect {
    let first = points.first().copied().unwrap_or_default();
    points.iter().fold(Rect::from_points(first, first), |r, p| r.union_pt(*p))
}

/// Width and height of a clump at most, mm.
const CLUMP: f64 = 4.0;
/// Strokes whose ends are no farther apart than this lie on each other, mm.
const TOGETHER_MM: f64 = 1e-6;

/// What a query writes on.
#[derive(Debug, Default)]
struct Scratch {
    met: Met,
    near: Vec<usize>,
    /// Strokes, how much of them lies inside, and whether they are touched.
    along: Vec<(usize, f64, bool)>,
    /// The stroke that the last place in its way touched.
    last: Option<usize>,
}

impl Obstacles {
    /// The ink of a group.
    #[must_use]
    pub fn of(group: &Group) -> Self {
        let mut all = Self::default();
        group.walk(&mut |node| match node {
            Node::Mark(mark) => all.add(mark),
            Node::Text(text) => all.boxes.extend(text.boxes()),
            Node::Group(_) => {}
        });
        all.index();
        all
    }

    /// No ink, for what will be drawn where the other ink is: it grows without being looked through again.
    #[must_use]
    pub fn over(other: &Self) -> Self {
        Self { grid: other.grid.blank(), grows: true, ..Self::default() }
    }

    /// Adds the ink of a group to it.
    pub fn extend(&mut self, group: &Group) {
        let more = Self::of(group);
        let before = self.strokes.len();
        let known = [self.clumps.len(), self.areas.len(), self.boxes.len()];
        self.strokes.extend(more.strokes);
        let later = |clump: Clump| Clump {
            strokes: clump.strokes.start + before..clump.strokes.end + before,
            copies: clump.copies.iter().map(|copy| copy + before).collect(),
            ..clump
        };
        self.clumps.extend(more.clumps.into_iter().map(later));
        self.areas.extend(more.areas);
        self.boxes.extend(more.boxes);
        if self.grows {
            self.enter(known);
        } else {
            self.index();
        }
    }

    /// Clumps that lie on each other become one, and so do areas: each stroke is asked for by itself where its place matters,
    /// and none where it does not.
    fn gather(&mut self) {
        let rounded = |at: Point| [at.x, at.y].map(|x| (x / TOGETHER_MM).round() as i64);
        let corners = |own: Rect| (rounded(own.origin()), rounded(Point::new(own.x1, own.y1)));
        // Of a stroke that stands alone its ends and its width, of several together their box and how many they are.
        let mut first_of: HashMap<(Ends, usize, u64), usize> = HashMap::new();
        let mut gathered: Vec<Clump> = Vec::with_capacity(self.clumps.len());
        for clump in self.clumps.drain(..) {
            let key = match &self.strokes[clump.strokes.clone()] {
                [(a, b, half)] => ((rounded(*a), rounded(*b)), 1, half.to_bits()),
                several => (corners(clump.bounds), several.len(), 0),
            };
            match first_of.entry(key) {
                Entry::Occupied(known) => {
                    let first = &mut gathered[*known.get()];
                    first.bounds = first.bounds.union(clump.bounds);
                    first.copies.extend(clump.all());
                }
                Entry::Vacant(new) => {
                    new.insert(gathered.len());
                    gathered.push(clump);
                }
            }
        }
        self.clumps = gathered;
        let mut first_of: HashMap<Ends, usize> = HashMap::new();
        let mut gathered: Vec<Area> = Vec::with_capacity(self.areas.len());
        for area in self.areas.drain(..) {
            match first_of.entry(corners(area.bounds)) {
                Entry::Occupied(known) => {
                    let first = &mut gathered[*known.get()];
                    first.bounds = first.bounds.union(area.bounds);
                    first.outlines.extend(area.outlines);
                }
                Entry::Vacant(new) => {
                    new.insert(gathered.len());
                    gathered.push(area);
                }
            }
        }
        self.areas = gathered;
    }

    fn index(&mut self) {
        self.gather();
        let strokes = self.strokes.iter().map(|(a, b, _)| Rect::from_points(*a, *b));
        let all = strokes.chain(self.boxes.iter().copied()).chain(self.areas.iter().map(|area| area.bounds));
        let whole = all.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        self.grid = Grid::new(whole);
        self.enter([0; Kind::COUNT]);
    }

    /// Enters in the grid what has come after so many of each kind.
    fn enter(&mut self, [clumps, areas, boxes]: [usize; Kind::COUNT]) {
        for (i, clump) in self.clumps.iter().enumerate().skip(clumps) {
            match &self.strokes[clump.strokes.clone()] {
                [(a, b, half)] => {
                    self.grid.add_stroke(Kind::Clump.number(i), *a, *b, *half + TOGETHER_MM);
                }
                _ => self.grid.add(Kind::Clump.number(i), clump.bounds),
            }
        }
        for (i, area) in self.areas.iter().enumerate().skip(areas) {
            self.grid.add(Kind::Area.number(i), area.bounds);
        }
        for (i, own) in self.boxes.iter().enumerate().skip(boxes) {
            self.grid.add(Kind::Box.number(i), *own);
        }
    }

    /// What has this number in the grid.
    fn thing(&self, number: usize) -> Thing<'_> {
        let (place, kind) = (number / Kind::COUNT, number % Kind::COUNT);
        if kind == Kind::Clump as usize {
            Thing::Clump(&self.clumps[place])
        } else if kind == Kind::Area as usize {
            Thing::Area(&self.areas[place])
        } else {
            Thing::Box(place)
        }
    }

    fn count(&self) -> usize {
        Kind::COUNT * self.clumps.len().max(self.areas.len()).max(self.boxes.len())
    }

    fn add(&mut self, mark: &Mark) {
        if mark.backdrop {
            return;
        }
        let half = mark.pen.map_or(0.0, |pen| pen.width / 2.0);
        for (n, (a, b)) in mark.shape.outline().into_iter().enumerate() {
            let own = Rect::from_points(a, b).inflate(half, half);
            let at = self.strokes.len();
            self.strokes.push((a, b, half));
            let last = self.clumps.last_mut().filter(|_| n > 0);
            match last.map(|clump| (clump.bounds.union(own), clump)) {
                Some((bounds, clump)) if bounds.width().max(bounds.height()) <= CLUMP => {
                    clump.bounds = bounds;
                    clump.strokes.end = at + 1;
                }
                _ => self.clumps.push(Clump { strokes: at..at + 1, copies: Vec::new(), bounds: own }),
            }
        }
        if let (Some(Tone::Ink), Shape::Polygon(points)) = (mark.fill, &mark.shape) {
            self.areas.push(Area { bounds: around(points), outlines: vec![points.clone()] });
        }
    }

    /// Whether a stroke of a clump may lie in a box: of those that lie on each other the first one tells.
    fn may_touch(&self, clump: &Clump, tight: Rect) -> bool {
        let (a, b, half) = self.strokes[clump.strokes.start];
        let near = half + 2.0 * TOGETHER_MM;
        // Those of several strokes have more places than the first of them.
        let tells = clump.strokes.len() == 1 && !clump.copies.is_empty();
        clump.bounds.overlaps(tight) && (!tells || clip(a, b, tight.inflate(near, near)).is_some())
    }

    /// Whether a box costs nothing: found out at the first thing that is in its way.
    #[must_use]
    pub fn is_free(&self, own: Rect) -> bool {
        let tight = own.inflate(CLEARANCE, CLEARANCE);
        let wide = own.inflate(WORD, CLEARANCE);
        let free_of = |number: usize| match self.thing(number) {
            Thing::Clump(clump) => {
                let apart = |i: usize| {
                    let (a, b, half) = self.strokes[i];
                    clip(a, b, tight.inflate(half, half)).is_none()
                };
                !self.may_touch(clump, tight) || clump.all().all(apart)
            }
            Thing::Area(area) => area.entered_by(tight) == 0,
            Thing::Box(i) => !self.boxes[i].overlaps(wide) || between(own, self.boxes[i]).0 == 0.0,
        };
        let flow = |is_free: bool| if is_free { ControlFlow::Continue(()) } else { ControlFlow::Break(()) };
        self.grid.visit(wide, |number| flow(free_of(number))).is_continue()
    }

    /// The cost of a box up to `limit`: one that costs more costs at least that.
    #[must_use]
    pub fn cost_up_to(&self, own: Rect, limit: f64) -> f64 {
        self.cost_within(own, 0.0, limit).0
    }

    /// Whether a stroke touches a box.
    fn touches(&self, stroke: usize, own: Rect) -> bool {
        let (a, b, half) = self.strokes[stroke];
        clip(a, b, own.inflate(half + 0.08, half + 0.08)).is_some()
    }

    /// `before` and the cost of a box, not counted further once it is `limit`; and whether the box touches as far
    /// as was counted.
    fn cost_within(&self, own: Rect, before: f64, limit: f64) -> (f64, bool) {
        let mut cost = 0.0;
        let mut touch = false;
        let tight = own.inflate(CLEARANCE, CLEARANCE);
        let wide = own.inflate(WORD, CLEARANCE);
        let Scratch { met, near, along, last } = &mut *self.scratch.borrow_mut();
        // Of places beside each other one stroke is in the way of many.
        if before + TOUCH >= limit && last.is_some_and(|i| self.touches(i, own)) {
            return (before + TOUCH, true);
        }
        near.clear();
        along.clear();
        met.begin(self.count());
        let mut entered = 0;
        // A stroke lies in the cells that it touches with its own width.
        let found = self.grid.visit(wide, |number| {
            match self.thing(number) {
                Thing::Clump(clump) => {
                    if !clump.bounds.overlaps(tight)
                        || !met.first_time(number)
                        || !self.may_touch(clump, tight)
                    {
                        return ControlFlow::Continue(());
                    }
                    for i in clump.all() {
                        let (a, b, half) = self.strokes[i];
                        if let Some((t0, t1)) = clip(a, b, tight.inflate(half, half)) {
                            let touches = self.touches(i, own);
                            if touches && before + TOUCH >= limit {
                                *last = Some(i);
                                return ControlFlow::Break(());
                            }
                            along.push((i, (t1 - t0) * a.distance(b), touches));
                        }
                    }
                }
                Thing::Area(area) => {
                    if area.bounds.overlaps(tight) && met.first_time(number) {
                        entered += area.entered_by(tight);
                    }
                }
                Thing::Box(i) => {
                    if self.boxes[i].overlaps(wide) && met.first_time(number) {
                        near.push(i);
                    }
                }
            }
            ControlFlow::Continue(())
        });
        if found.is_break() {
            return (before + TOUCH, true);
        }
        // Sums depend on the order of their parts.
        along.sort_unstable_by_key(|(i, ..)| *i);
        for &(_, inside, touches) in along.iter() {
            touch |= touches;
            cost += if touches { TOUCH * (1.0 + inside) } else { 12.0 + 4.0 * inside };
        }
        for _ in 0..entered {
            cost += TOUCH;
            touch = true;
        }
        near.sort_unstable();
        for other in near.iter().map(|i| &self.boxes[*i]) {
            let (c, t) = between(own, *other);
            cost += c;
            touch |= t;
        }
        (before + cost, touch)
    }
}

fn between(a: Rect, b: Rect) -> (f64, bool) {
    if !a.inflate(0.08, 0.08).intersect(b).is_zero_area() {
        let common = a.intersect(b).area().max(0.1);
        (TOUCH * (1.0 + common), true)
    } else if !a.inflate(CLEARANCE, CLEARANCE).intersect(b).is_zero_area() {
        (15.0, false)
    } else if !a.inflate(WORD, 0.0).intersect(b).is_zero_area() {
        // On one line and this near they would be read as one.
        (20.0, false)
    } else {
        (0.0, false)
    }
}

/// The labels that stand in a crowd for which there is no room, by index.
fn crowded(requests: &[Request]) -> Vec<bool> {
    let middle = |request: &Request| match request.sites.first() {
        Some(Site::Around { at, .. }) => *at,
        Some(Site::Along { from, to }) => from.midpoint(*to),
        None => Point::ORIGIN,
    };
    let places: Vec<Point> = requests.iter().map(middle).collect();
    let field = |at: Point| [at.x, at.y].map(|x| (x / AROUND).floor() as i64);
    let mut fields: HashMap<[i64; 2], Vec<Point>> = HashMap::new();
    for at in &places {
        fields.entry(field(*at)).or_default().push(*at);
    }
    let in_crowd = |at: &Point| {
        let [x, y] = field(*at);
        let fields = (-1..=1)
            .flat_map(|i| (-1..=1).map(move |j| [x.saturating_add(i), y.saturating_add(j)]))
            .filter_map(|f| fields.get(&f));
        let near = fields.flatten().filter(|other| other.distance(*at) < AROUND);
        // Counted no further than it matters.
        near.take(CROWD + 1).count() > CROWD
    };
    places.iter().map(in_crowd).collect()
}

/// Places the labels clear of the ink in `group` and of each other, and draws them in a group of their
/// own. Returns that group; a label that must stand and finds no free place stands where it costs least. In a crowd for
/// which there is no room each is left out that finds none; the group's data tell the names of those that had to stand.
#[must_use]
pub fn place(group: &Group, requests: &[Request], within: Option<Rect>) -> Group {
    place_among(group, requests, within, &Others::default())
}

/// The same among others that are named elsewhere, or not at all.
#[must_use]
pub fn place_among(group: &Group, requests: &[Request], within: Option<Rect>, others: &Others) -> Group {
    /// Of nobody's request.
    const NOBODY: usize = usize::MAX;
    let obstacles = Obstacles::of(group);
    let bodies: Vec<Body> = requests.iter().map(Body::new).collect();
    let anchors = requests.iter().enumerate().filter_map(|(i, r)| match r.sites[..] {
        [Site::Around { at, .. }] => Some((i, r.tie.unwrap_or(at))),
        _ => None,
    });
    let anchors = anchors.chain(others.points.iter().map(|at| (NOBODY, *at))).collect();
    let lines_named = requests.iter().enumerate().filter_map(|(i, r)| match (r.stroke, &r.sites[..]) {
        (Some((from, to)), _) | (None, &[Site::Along { from, to }, ..]) => Some((i, from, to)),
        _ => None,
    });
    let lines_named = lines_named.chain(others.lines.iter().map(|(a, b)| (NOBODY, *a, *b))).collect();
    let strangers = Strangers::new(anchors, lines_named);
    let crowded = crowded(requests);
    let yields =
        requests.iter().zip(&crowded).map(|(request, crowded)| request.optional || *crowded).collect();
    let market = Market { requests, yields, bodies: &bodies, obstacles, strangers, within };

    let mut all: Vec<Choices> = (0..requests.len()).map(|i| market.choices(i, Reach::Near)).collect();
    // Those with the fewest free places choose first; among equals, those that must stand, then order.
    let mut order: Vec<usize> = (0..requests.len()).collect();
    order.sort_by_key(|i| (market.yields[*i], all[*i].free, *i));
    let mut standing = Standing::new(&market, &all);
    for pass in 0..=PASSES {
        let mut moved = false;
        for &i in &order {
            moved |= standing.settle(i, &mut all);
        }
        if pass > 0 && (!moved || standing.touching(&order, &all) > MOST_TOUCHING) {
            break;
        }
    }
    standing.untangle(&order, &mut all);
    let chosen = standing.chosen;

    let mut out = Group::new("labels");
    let left_out =
        requests.iter().zip(&chosen).filter(|(request, chosen)| !request.optional && chosen.is_none());
    let unnamed: Vec<&str> = left_out.flat_map(|(request, _)| &request.names).map(String::as_str).collect();
    if !unnamed.is_empty() {
        out = out.data(UNNAMED, unnamed.join(" "));
    }
    for (i, request) in requests.iter().enumerate() {
        let Some(candidate) = chosen[i].map(|c| &all[i].sorted[c]) else { continue };
        let at = bodies[i].start(candidate.centre);
        if !request.pieces.is_empty() {
            put_pieces(&mut out, request, at, candidate.leader);
            continue;
        }
        let mut own = match request.names.as_slice() {
            [] => Group::default(),
            names => Group::new("name").data("of", names.join(" ")),
        };
        own.life = request.life;
        let apart = !request.names.is_empty() || request.life.is_some();
        let into = if apart { &mut own } else { &mut out };
        if let Some((from, to)) = candidate.leader {
            into.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(0.13)).class("leader"));
        }
        if let Some(radius) = request.ring {
            let centre = bodies[i].line.ink_at(at).center();
            into.mark(Mark::stroke(Shape::Circle { centre, radius }, Pen::solid(0.18)).class("ring"));
        }
        bodies[i].line.put(into, at, request.class);
        if apart {
            out.group(own);
        }
    }
    out
}

/// A name in its pieces, each a group of its own, where the whole stands.
fn put_pieces(out: &mut Group, request: &Request, at: Point, leader: Option<(Point, Point)>) {
    let first = request.pieces.first().map(|piece| piece.life.born);
    let mut pen = at;
    for piece in &request.pieces {
        let mut own = Group::new("name").data("of", piece.names.join(" ")).lived(Some(piece.life));
        if let Some((from, to)) = leader.filter(|_| Some(piece.life.born) == first) {
            own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(0.13)).class("leader"));
        }
        let line = piece.text.set(request.size);
        line.put(&mut own, pen, request.class);
        pen.x += line.width;
        out.group(own);
    }
}

/// What the price of a place depends on.
struct Market<'a> {
    requests: &'a [Request],
    /// Which are left out where no free place is found.
    yields: Vec<bool>,
    bodies: &'a [Body],
    obstacles: Obstacles,
    strangers: Strangers,
    within: Option<Rect>,
}

/// The candidates of a label.
struct Choices {
    /// Ascending by cost: those that touch nothing fixed, and after [`Market::complete`] all.
    sorted: Vec<Candidate>,
    /// How many touch nothing fixed.
    free: usize,
    /// Those that touch something, uncounted, in their order.
    rest: Vec<Candidate>,
    /// How many there may be.
    most: usize,
    /// What the labels of all of them fill together.
    reach: Rect,
}

impl Market<'_> {
    fn choices(&self, i: usize, how_far: Reach) -> Choices {
        let most = if how_far == Reach::Near { 240 } else { 1200 };
        let (mut sorted, mut rest) = (Vec::new(), Vec::new());
        let mut reach: Option<Rect> = None;
        for (rank, site) in self.requests[i].sites.iter().enumerate() {
            for mut candidate in candidates(&self.requests[i], *site, &self.bodies[i], how_far) {
                candidate.site = rank;
                candidate.cost += 5.0 * rank as f64;
                let preference = candidate.cost;
                self.price(&mut candidate, i, TOUCH);
                let own = self.bodies[i].boxes(candidate.centre);
                let own = own.chain(candidate.leader.map(|(a, b)| Rect::from_points(a, b)));
                reach = own.chain(reach).reduce(|a, b| a.union(b));
                if candidate.cost < TOUCH {
                    sorted.push(Candidate { counted: true, ..candidate });
                } else {
                    rest.push(Candidate { cost: preference, touches_ink: false, ..candidate });
                }
            }
        }
        sorted.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let free = sorted.len().min(most);
        sorted.truncate(most);
        Choices { sorted, free, rest, most, reach: reach.unwrap_or_default() }
    }

    /// Counts what was left uncounted.
    fn complete(&self, i: usize, choices: &mut Choices) {
        let mut rest = std::mem::take(&mut choices.rest);
        for candidate in &mut rest {
            self.price(candidate, i, f64::INFINITY);
            candidate.counted = true;
        }
        rest.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        choices.sorted.append(&mut rest);
        choices.sorted.truncate(choices.most);
    }
}

/// The labels as they stand.
struct Standing<'a> {
    market: &'a Market<'a>,
    chosen: Vec<Option<usize>>,
    /// The boxes of each label where it stands.
    boxes: Vec<Vec<Rect>>,
    /// How dearly the others pay for touching it.
    weights: Vec<f64>,
    /// What is in reach of a label has changed since it was settled, or since it was asked whether it touches.
    unsettled: Vec<bool>,
    touching: Vec<Option<bool>>,
    texts: Grid,
    leaders: Grid,
    scratch: Scratch,
    /// How many places have been looked at.
    looks: usize,
}

impl<'a> Standing<'a> {
    fn new(market: &'a Market<'a>, all: &[Choices]) -> Self {
        let area = all.iter().map(|c| c.reach).reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        Self {
            market,
            chosen: vec![None; all.len()],
            boxes: vec![Vec::new(); all.len()],
            weights: vec![1.0; all.len()],
            unsettled: vec![true; all.len()],
            touching: vec![None; all.len()],
            texts: Grid::new(area),
            leaders: Grid::new(area),
            scratch: Scratch::default(),
            looks: 0,
        }
    }

    /// In a crowd some labels still touch something. They look further away, and whoever is touched again
    /// and again becomes dearer to touch, until those in its way move.
    fn untangle(&mut self, order: &[usize], all: &mut [Choices]) {
        let market = self.market;
        let optional = |i: &usize| market.yields[*i];
        let mut looked: Vec<bool> = vec![false; all.len()];
        let (mut moves, before) = (0, self.looks);
        while moves < MOVES && self.looks - before < LOOKS {
            let touching: Vec<usize> = order.iter().copied().filter(|i| self.touches(*i, all)).collect();
            if touching.len() > MOST_TOUCHING || touching.iter().all(optional) {
                break;
            }
            moves += touching.len();
            for &i in &touching {
                self.weights[i] += 1.0;
                self.disturb(i, all);
                if !std::mem::replace(&mut looked[i], true) {
                    self.choose(i, None, all);
                    all[i] = market.choices(i, Reach::Far);
                    self.looks += all[i].sorted.len() + all[i].rest.len();
                    self.unsettled[i] = true;
                }
                self.settle(i, all);
            }
        }
        for i in order.iter().copied().filter(optional) {
            if self.touches(i, all) {
                self.choose(i, None, all);
            }
        }
    }

    /// How many labels touch something.
    fn touching(&mut self, order: &[usize], all: &[Choices]) -> usize {
        order.iter().filter(|i| self.touches(**i, all)).count()
    }

    /// Whatever may stand near a label, as it stands, has to be looked at again.
    fn disturb(&mut self, i: usize, all: &[Choices]) {
        let Some(own) = self.chosen[i].map(|c| &all[i].sorted[c]) else { return };
        let leader = own.leader.map(|(a, b)| Rect::from_points(a, b));
        let extent = self.boxes[i].iter().copied().chain(leader).reduce(|a, b| a.union(b));
        // No label minds another farther away than a word's blank.
        let Some(extent) = extent.map(|e| e.inflate(WORD + CLEARANCE, WORD + CLEARANCE)) else { return };
        for (j, other) in all.iter().enumerate().filter(|(j, _)| *j != i) {
            if other.reach.overlaps(extent) {
                self.unsettled[j] = true;
                self.touching[j] = None;
            }
        }
    }

    fn choose(&mut self, i: usize, choice: Option<usize>, all: &[Choices]) {
        self.disturb(i, all);
        if let Some(old) = self.chosen[i].map(|c| &all[i].sorted[c]) {
            self.boxes[i].iter().for_each(|own| self.texts.remove(i, *own));
            if let Some((a, b)) = old.leader {
                self.leaders.remove(i, Rect::from_points(a, b));
            }
        }
        self.boxes[i].clear();
        if let Some(new) = choice.map(|c| &all[i].sorted[c]) {
            self.boxes[i].extend(self.market.bodies[i].boxes(new.centre));
            self.boxes[i].iter().for_each(|own| self.texts.add(i, *own));
            if let Some((a, b)) = new.leader {
                self.leaders.add_stroke(i, a, b, 0.0);
            }
        }
        self.chosen[i] = choice;
        self.touching[i] = None;
        self.disturb(i, all);
    }

    /// Moves a label to its best place given all others; whether it moved.
    fn settle(&mut self, i: usize, all: &mut [Choices]) -> bool {
        // Among the same others the same place is the best.
        if !std::mem::replace(&mut self.unsettled[i], false) {
            return false;
        }
        let best = self.best(i, all);
        let moved = best != self.chosen[i];
        if moved {
            self.choose(i, best, all);
        }
        moved
    }

    fn best(&mut self, i: usize, all: &mut [Choices]) -> Option<usize> {
        let optional = self.market.yields[i];
        let mut best: Option<(f64, usize)> = None;
        let mut c = 0;
        loop {
            let limit = best.map_or(f64::INFINITY, |(cost, _)| cost);
            // Whatever was left uncounted costs as much as to touch something.
            let exhausted = c == all[i].sorted.len() && !optional && limit > TOUCH;
            if exhausted && !all[i].rest.is_empty() {
                self.market.complete(i, &mut all[i]);
            }
            let Some(candidate) = all[i].sorted.get(c) else { break };
            if candidate.cost >= limit {
                break; // sorted by cost: none of the rest can be better
            }
            let (cost, touch) = self.cost(i, candidate, all, limit);
            if !(optional && (touch || cost > 60.0)) && cost < limit {
                best = Some((cost, c));
            }
            c += 1;
        }
        best.map(|(_, c)| c)
    }

    /// What a candidate costs among the others, and whether it touches anything; not counted further once
    /// it costs `limit`.
    fn cost(&mut self, i: usize, candidate: &Candidate, all: &[Choices], limit: f64) -> (f64, bool) {
        self.looks += 1;
        let Scratch { met, near, .. } = &mut self.scratch;
        near.clear();
        met.begin(all.len());
        let mut meet = |j: usize| {
            if j != i && met.first_time(j) {
                near.push(j);
            }
            ControlFlow::Continue(())
        };
        let body = &self.market.bodies[i];
        for own in body.boxes(candidate.centre) {
            let own = own.inflate(WORD, CLEARANCE);
            let _ = self.texts.visit(own, &mut meet);
            let _ = self.leaders.visit(own, &mut meet);
        }
        if let Some((a, b)) = candidate.leader {
            let _ = self.texts.visit_along(a, b, 0.3, &mut meet);
            let _ = self.leaders.visit_along(a, b, 0.0, &mut meet);
        }
        near.sort_unstable();
        let mut cost = candidate.cost;
        let mut touch = candidate.touches_ink;
        for &j in near.iter() {
            let Some(other) = self.chosen[j].map(|o| &all[j].sorted[o]) else { continue };
            let boxes = || body.boxes(candidate.centre);
            let (c, t) = conflict(boxes, candidate.leader, &self.boxes[j], other.leader);
            cost += c * self.weights[j];
            touch |= t;
            if cost >= limit {
                break;
            }
        }
        (cost, touch)
    }

    fn touches(&mut self, i: usize, all: &[Choices]) -> bool {
        let Some(own) = self.chosen[i] else { return false };
        if let Some(known) = self.touching[i] {
            return known;
        }
        let touch = self.cost(i, &all[i].sorted[own], all, f64::INFINITY).1;
        self.touching[i] = Some(touch);
        touch
    }
}

/// What two labels cost each other, and whether they touch: their boxes and leaders.
fn conflict<I: Iterator<Item = Rect>>(
    boxes: impl Fn() -> I,
    leader: Option<(Point, Point)>,
    other_boxes: &[Rect],
    other_leader: Option<(Point, Point)>,
) -> (f64, bool) {
    let mut cost = 0.0;
    let mut touch = false;
    for x in boxes() {
        for y in other_boxes {
            let (c, t) = between(x, *y);
            cost += c;
            touch |= t;
        }
    }
    let whole = |boxes: &mut dyn Iterator<Item = Rect>| boxes.reduce(|a, b| a.union(b));
    if let (false, Some(x), Some(y)) = (touch, whole(&mut boxes()), whole(&mut other_boxes.iter().copied())) {
        // An index that reaches into another name's is read with it.
        let both = x.intersect(y);
        if both.width().min(both.height()) > INTO {
            cost += TOUCH;
            touch = true;
        }
    }
    let crossed = match (leader, other_leader) {
        (Some((a, b)), Some((c, d))) if crossing(a, b, c, d) => 200.0,
        _ => 0.0,
    };
    let mut across = |(from, to): (Point, Point), r: Rect| {
        if clip(from, to, r.inflate(0.3, 0.3)).is_some() {
            cost += TOUCH;
            touch = true;
        }
    };
    if let Some(leader) = leader {
        other_boxes.iter().for_each(|r| across(leader, *r));
    }
    if let Some(leader) = other_leader {
        boxes().for_each(|r| across(leader, r));
    }
    cost += crossed;
    (cost, touch)
}

pub(super) fn crossing(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

impl Market<'_> {
    /// Adds what ink, strangers and the edge cost; not counted further once it is `limit`.
    fn price(&self, candidate: &mut Candidate, index: usize, limit: f64) {
        let Self { obstacles, strangers, .. } = self;
        let body = &self.bodies[index];
        for own in body.boxes(candidate.centre) {
            let (cost, touch) = obstacles.cost_within(own, candidate.cost, limit);
            candidate.cost = cost;
            candidate.touches_ink |= touch;
            if self.within.is_some_and(|w| !w.contains_rect(own)) {
                candidate.cost += TOUCH;
                candidate.touches_ink = true;
            }
            if candidate.cost >= limit {
                return;
            }
        }
        let Scratch { met, near, .. } = &mut *obstacles.scratch.borrow_mut();
        if let Some((from, to)) = candidate.leader {
            // A leader may leave its own point, so only what it crosses further out counts.
            let start = from.lerp(to, (1.5 / from.distance(to).max(1.5)).min(1.0));
            let own = Rect::from_points(start, to);
            met.begin(obstacles.count());
            let (mut crossed, mut struck) = (0, false);
            let _ = obstacles.grid.visit(own, |number| {
                match obstacles.thing(number) {
                    Thing::Clump(clump) if clump.bounds.overlaps(own) && met.first_time(number) => {
                        let crosses = |i: &usize| {
                            let (a, b, _) = obstacles.strokes[*i];
                            crossing(start, to, a, b)
                        };
                        crossed += clump.all().filter(crosses).count();
                    }
                    Thing::Box(i) => {
                        struck |= clip(start, to, obstacles.boxes[i].inflate(0.3, 0.3)).is_some();
                    }
                    Thing::Clump(_) | Thing::Area(_) => {}
                }
                ControlFlow::Continue(())
            });
            for _ in 0..crossed {
                candidate.cost += 40.0;
            }
            if struck {
                candidate.cost += TOUCH;
                candidate.touches_ink = true;
            }
        }
        let request = &self.requests[index];
        if let Some((from, to)) = candidate.leader {
            // A name that is tied to what it names is no stranger's, but its leader might be.
            if request.strict {
                candidate.cost += self.astray(index, candidate.site, from, to);
            }
            return;
        }
        let Some(own) = body.boxes(candidate.centre).reduce(|a, b| a.union(b)) else { return };
        match self.requests[index].sites[candidate.site] {
            Site::Around { at, .. } => {
                let clear = distance(own, at) + BESIDE;
                let stranger = |i: usize| {
                    let (j, p) = strangers.points[i];
                    j != index && p.distance(at) > 0.2
                };
                let reach = own.inflate(clear, clear);
                strangers.point_grid.near(reach, strangers.points.len(), met, near, stranger);
                for (_, stranger) in near.iter().map(|i| strangers.points[*i]) {
                    let far = distance(own, stranger);
                    if far < clear {
                        candidate.cost += 25.0 + 10.0 * (clear - far);
                    }
                    if far + BESIDE < clear {
                        candidate.cost += MISREAD;
                    }
                    if request.strict && far + BESIDE + NEARER < clear {
                        candidate.cost += TOUCH;
                        candidate.touches_ink = true;
                    }
                }
                // Beyond a line that does not end in its point a name is read as that of another point.
                let line = |i: usize| strangers.lines[i].0 != index;
                strangers.line_grid.near(reach, strangers.lines.len(), met, near, line);
                let (centre, foot) = (own.center(), own.center().lerp(at, 0.95));
                for (_, a, b) in near.iter().map(|i| strangers.lines[*i]) {
                    let ends = [a, b].iter().any(|end| end.distance(at) < 0.3);
                    if !ends && crossing(centre, foot, a, b) {
                        candidate.cost += ACROSS;
                    }
                }
                // What stands at the middle of a dimension line is read as its number.
                let dimension = |i: usize| {
                    let (j, ..) = strangers.lines[i];
                    let class = self.requests.get(j).map(|request| request.class);
                    j != index && class == Some(super::dimensions::CLASS)
                };
                strangers.line_grid.near(reach, strangers.lines.len(), met, near, dimension);
                for (_, a, b) in near.iter().map(|i| strangers.lines[*i]) {
                    let far = gap(own, a, b);
                    if far + BESIDE < clear {
                        candidate.cost += MISREAD + 6.0 * (clear - far);
                    }
                }
            }
            Site::Along { from, to } => {
                let (from, to) = request.stroke.unwrap_or((from, to));
                let clear = gap(own, from, to) + BESIDE;
                let stranger = |i: usize| strangers.lines[i].0 != index;
                let reach = own.inflate(clear, clear);
                let centre = own.center();
                let foot = centre.lerp(nearest(centre, from, to), 0.95);
                strangers.line_grid.near(reach, strangers.lines.len(), met, near, stranger);
                for (_, a, b) in near.iter().map(|i| strangers.lines[*i]) {
                    let far = gap(own, a, b);
                    if far < clear {
                        candidate.cost += 4.0 + 6.0 * (clear - far);
                    }
                    // Of two lines that nearly fall together the names stand beside both.
                    if far + BESIDE + TOGETHER < clear {
                        candidate.cost += MISREAD;
                    }
                    let behind = || crossing(centre, foot, a, b);
                    if request.strict && (far + BESIDE + NEARER < clear || behind()) {
                        candidate.cost += TOUCH;
                        candidate.touches_ink = true;
                    }
                }
            }
        }
    }
}

impl Market<'_> {
    /// What a leader costs that might be taken for another's: it ends beside another line, or passes another point.
    fn astray(&self, index: usize, site: usize, from: Point, to: Point) -> f64 {
        let (met, near) = (&mut Met::default(), &mut Vec::new());
        let strangers = &self.strangers;
        let request = &self.requests[index];
        match request.sites[site] {
            Site::Along { .. } => {
                let foot = Rect::from_points(from, from).inflate(PASSING, PASSING);
                let stranger = |i: usize| strangers.lines[i].0 != index;
                strangers.line_grid.near(foot, strangers.lines.len(), met, near, stranger);
                let beside = near.iter().map(|i| strangers.lines[*i]);
                30.0 * beside.filter(|(_, a, b)| to_line(from, *a, *b) < PASSING).count() as f64
            }
            Site::Around { at, .. } => {
                let own = request.tie.unwrap_or(at);
                let reach = Rect::from_points(from, to).inflate(PASSING, PASSING);
                let stranger = |i: usize| {
                    let (j, p) = strangers.points[i];
                    j != index && p.distance(own) > 0.2
                };
                strangers.point_grid.near(reach, strangers.points.len(), met, near, stranger);
                let passed = near.iter().map(|i| strangers.points[*i].1);
                let cost = |p: Point| match to_line(p, from, to) {
                    _ if p.distance(from) < own.distance(from) => TOUCH / 2.0,
                    far if far < PASSING => 45.0,
                    _ => 0.0,
                };
                passed.map(cost).sum()
            }
        }
    }
}

/// What else is named: a name nearer to a stranger would be read as the stranger's.
struct Strangers {
    points: Vec<(usize, Point)>,
    lines: Vec<(usize, Point, Point)>,
    point_grid: Grid,
    line_grid: Grid,
}

impl Strangers {
    fn new(points: Vec<(usize, Point)>, lines: Vec<(usize, Point, Point)>) -> Self {
        let of_points = points.iter().map(|(_, p)| Rect::from_points(*p, *p));
        let of_lines = lines.iter().map(|(_, a, b)| Rect::from_points(*a, *b));
        let area = of_points.chain(of_lines).reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        let mut point_grid = Grid::new(area);
        for (i, (_, p)) in points.iter().enumerate() {
            point_grid.add(i, Rect::from_points(*p, *p));
        }
        let mut line_grid = Grid::new(area);
        for (i, (_, a, b)) in lines.iter().enumerate() {
            line_grid.add_stroke(i, *a, *b, 0.0);
        }
        Self { points, lines, point_grid, line_grid }
    }
}

/// How far from its place a label looks for room.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Reach {
    Near,
    Far,
}

/// How far a box is from a stroke; zero where they meet.
fn gap(own: Rect, a: Point, b: Point) -> f64 {
    if clip(a, b, own).is_some() {
        return 0.0;
    }
    let corners = [(own.x0, own.y0), (own.x1, own.y0), (own.x1, own.y1), (own.x0, own.y1)];
    let corners = corners.into_iter().map(|corner| to_line(corner.into(), a, b));
    corners.chain([distance(own, a), distance(own, b)]).fold(f64::INFINITY, f64::min)
}

fn to_line(p: Point, a: Point, b: Point) -> f64 {
    nearest(p, a, b).distance(p)
}

/// The point of a stroke that is nearest to another.
fn nearest(p: Point, a: Point, b: Point) -> Point {
    let d = b - a;
    let t = ((p - a).dot(d) / d.hypot2().max(1e-12)).clamp(0.0, 1.0);
    a.lerp(b, t)
}

fn distance(r: Rect, p: Point) -> f64 {
    let dx = (r.x0 - p.x).max(p.x - r.x1).max(0.0);
    let dy = (r.y0 - p.y).max(p.y - r.y1).max(0.0);
    libm::hypot(dx, dy)
}

/// Directions around a point in which a label may stand.
const DIRECTIONS: u32 = 24;

fn directions() -> impl Iterator<Item = f64> {
    (0..DIRECTIONS).map(|k| f64::from(k) * (std::f64::consts::TAU / f64::from(DIRECTIONS)))
}

fn candidates(request: &Request, site: Site, body: &Body, how_far: Reach) -> Vec<Candidate> {
    let half = body.half;
    let stand = |centre: Point, cost: f64, leader: Option<Point>| {
        let leader = request.tie.or(leader).map(|from| {
            let to = if let Some(radius) = request.ring {
                let d = from - centre;
                centre + d * (radius / d.hypot().max(1e-9)).min(1.0)
            } else {
                let own = Rect::from_center_size(centre, (2.0 * half.x + 0.8, 2.0 * half.y + 0.8));
                clip(from, centre, own).map_or(centre, |(t, _)| from.lerp(centre, t))
            };
            (from, to)
        });
        Candidate { centre, leader, cost, touches_ink: false, counted: false, site: 0 }
    };
    let mut all = Vec::with_capacity(DIRECTIONS as usize * 10);
    match site {
        Site::Around { at, radius, toward } => {
            let wanted = toward.unwrap_or(std::f64::consts::FRAC_PI_4);
            let weight = if toward.is_some() { 2.0 } else { 0.6 };
            // Sine, cosine and taste of each direction.
            let ways: Vec<((f64, f64), f64)> = directions()
                .map(|angle| (libm::sincos(angle), weight * (1.0 - libm::cos(angle - wanted))))
                .collect();
            for (ring, gap) in [0.6, 1.1, 1.8, 2.8, 4.2].into_iter().enumerate() {
                for (way, taste) in &ways {
                    let cost = 3.5 * ring as f64 + taste;
                    all.push(stand(beside(at, *way, radius + gap, half), cost, None));
                }
            }
            if request.leader || how_far == Reach::Far {
                for (ring, gap) in leaders([5.0, 7.0, 9.5, 12.0, 15.0], how_far) {
                    for (way, _) in &ways {
                        let centre = beside(at, *way, radius + gap, half);
                        let (sin, cos) = way;
                        let from = Point::new(at.x + (radius + 0.3) * cos, at.y - (radius + 0.3) * sin);
                        all.push(stand(centre, 30.0 + 4.0 * ring as f64, Some(from)));
                    }
                }
            }
        }
        Site::Along { from, to } => {
            let d = to - from;
            let length = d.hypot().max(1e-9);
            let normal = Vec2::new(d.y, -d.x) / length;
            let reach = (normal.x * half.x).abs() + (normal.y * half.y).abs();
            let reach = if let Some(radius) = request.ring { radius } else { reach };
            for (i, t) in [0.5, 0.42, 0.58, 0.34, 0.66, 0.27, 0.73, 0.2, 0.8].into_iter().enumerate() {
                for side in [1.0, -1.0] {
                    let up = if side * normal.y < 0.0 { 0.0 } else { 0.4 };
                    let taste = 0.8 * i as f64 + up;
                    for (ring, gap) in [0.8, 1.5, 2.6, 3.4].into_iter().enumerate() {
                        let centre = from + d * t + normal * (side * (reach + gap));
                        all.push(stand(centre, taste + 3.0 * ring as f64, None));
                    }
                    if request.leader || how_far == Reach::Far {
                        for (ring, gap) in leaders([4.0, 6.0, 8.5, 11.0], how_far) {
                            let foot = from + d * t;
                            let centre = foot + normal * (side * (reach + gap));
                            let start = foot + normal * (side * ENDS);
                            all.push(stand(centre, 30.0 + taste + 4.0 * ring as f64, Some(start)));
                        }
                    }
                }
            }
            if how_far == Reach::Far {
                // Square to the line there was no room: then to any side.
                for (i, t) in [0.5, 0.3, 0.7].into_iter().enumerate() {
                    let foot = from + d * t;
                    for angle in directions() {
                        let way = libm::sincos(angle);
                        let along = Vec2::new(way.1, -way.0);
                        // Along its own line a leader is not seen.
                        if along.cross(d).abs() < 0.4 * length {
                            continue;
                        }
                        for (ring, gap) in leaders([6.0, 9.0, 12.0], how_far) {
                            let centre = beside(foot, way, gap, half);
                            let cost = 34.0 + 0.8 * i as f64 + 4.0 * ring as f64;
                            all.push(stand(centre, cost, Some(foot + along * ENDS)));
                        }
                    }
                }
            }
        }
    }
    all
}

/// So far from the middle of its line a leader ends: on it, as far as can be seen.
const ENDS: f64 = 0.1;

/// The lengths of leaders, with their ranks: in a crowd they go on to half a page.
fn leaders<const N: usize>(near: [f64; N], reach: Reach) -> impl Iterator<Item = (usize, f64)> {
    const FAR: [f64; 12] = [18.0, 21.0, 24.0, 28.0, 32.0, 37.0, 43.0, 50.0, 58.0, 67.0, 77.0, 90.0];
    let far = if reach == Reach::Far { &FAR[..] } else { &[] };
    near.into_iter().chain(far.iter().copied()).enumerate()
}

/// Centre of a box that stands in the direction of this sine and cosine from a point with a clear gap between
/// them.
fn beside(at: Point, (sin, cos): (f64, f64), gap: f64, half: Vec2) -> Point {
    let x = half.x * (cos * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
    let y = half.y * (sin * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
    Point::new(at.x + gap * cos + x, at.y - gap * sin - y)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::figure::on_circle;
    use crate::sheet::overlap::overlaps_in;

    #[test]
    fn labels_of_a_crowd_of_points_stay_clear_of_ink_and_of_each_other() {
        let mut ink = Group::default();
        let mut requests = Vec::new();
        for i in 0..12 {
            let at = on_circle(Point::new(0.0, 0.0), 9.0, f64::from(i) * 0.53);
            ink.mark(Mark::stroke(Shape::Line(Point::new(0.0, 0.0), at), Pen::solid(0.5)));
            let site = Site::Around { at, radius: 0.5, toward: None };
            requests.push(Request::new(Rich::italic("a").sub("24"), 4.0, site, "label"));
        }
        let labels = place(&ink, &requests, None);
        ink.group(labels);
        assert_eq!(overlaps_in(&ink, None), vec![]);
        let mut texts = 0;
        ink.walk(&mut |node| texts += usize::from(matches!(node, Node::Text(_))));
        assert_eq!(texts, 12);
    }

    /// Lines that lie on each other, to the last digits or nearly so, cost what each of them costs, one after the other.
    #[test]
    fn lines_on_each_other_cost_what_they_cost_alone() {
        let (a, b) = (Point::new(0.0, 0.0), Point::new(40.0, 17.0));
        let pen = Pen::solid(0.25);
        let ink = |lines: &[(Point, Point)]| {
            let mut group = Group::default();
            for (from, to) in lines {
                group.mark(Mark::stroke(Shape::Line(*from, *to), pen));
            }
            Obstacles::of(&group)
        };
        let near = Point::new(40.0 + 1e-9, 17.0 - 1e-9);
        let (alone, other) = (ink(&[(a, b)]), ink(&[(a, near)]));
        let mut together = ink(&[(a, b), (a, near)]);
        let mut more = Group::default();
        more.mark(Mark::stroke(Shape::Line(a, b), pen));
        together.extend(&more);
        assert_eq!(together.clumps.len(), 1);
        for (x, y) in [(20.0, 8.5), (20.0, 6.0), (20.0, 9.4), (39.9, 17.5), (20.0, 30.0), (-2.0, -1.0)] {
            let own = Rect::from_center_size((x, y), (3.0, 2.0));
            let [first, second] = [&alone, &other].map(|obstacles| obstacles.cost_up_to(own, f64::INFINITY));
            assert_eq!(together.cost_up_to(own, f64::INFINITY), first + second + first, "at {x}, {y}");
            assert_eq!(together.is_free(own), alone.is_free(own) && other.is_free(own), "at {x}, {y}");
        }
    }

    /// Arrows and dots that lie on each other cost what each of them costs, and are asked for as one.
    #[test]
    fn heads_on_each_other_cost_what_they_cost_alone() {
        let pen = Pen::solid(0.25);
        let ink = |offsets: &[f64]| {
            let mut group = Group::default();
            for by in offsets {
                let at = Point::new(20.0 + by, 10.0 - by);
                let head = vec![at, at + Vec2::new(1.6, 0.5), at + Vec2::new(1.6, -0.5)];
                group.mark(Mark { fill: Some(Tone::Ink), ..Mark::stroke(Shape::Polygon(head), pen) });
                group.mark(Mark::stroke(Shape::Circle { centre: at, radius: 0.6 }, pen));
            }
            Obstacles::of(&group)
        };
        let offsets = [0.0, 1e-10, -1e-10];
        let together = ink(&offsets);
        assert_eq!((together.clumps.len(), together.areas.len()), (2, 1));
        let alone = offsets.map(|by| ink(&[by]));
        let mut costly = 0;
        for (x, y) in (0..30).flat_map(|x| (0..20).map(move |y| (x, y))) {
            let centre = (14.0 + 0.4 * f64::from(x), 6.0 + 0.4 * f64::from(y));
            let own = Rect::from_center_size(centre, (3.0, 2.0));
            let each = alone.iter().map(|one| one.cost_up_to(own, f64::INFINITY)).sum::<f64>();
            let cost = together.cost_up_to(own, f64::INFINITY);
            assert!((cost - each).abs() <= 1e-6 * each, "at {centre:?}: {cost} {each}");
            assert_eq!(together.is_free(own), alone.iter().all(|one| one.is_free(own)), "at {centre:?}");
            costly += usize::from(cost > 0.0);
        }
        assert!(costly > 20, "{costly}");
    }

    /// Ink that grows costs what the same ink costs that was there from the beginning, wherever it lies, and nothing is entered
    /// twice: the cells hold as many things.
    #[test]
    fn ink_that_grows_costs_what_it_costs_at_once() {
        let pen = Pen::solid(0.25);
        let mut frame = Group::default();
        let corners = [(0.0, 0.0), (100.0, 0.0), (100.0, 60.0), (0.0, 60.0)].map(Point::from);
        frame.mark(Mark::stroke(Shape::Polygon(corners.to_vec()), pen));
        let mut grown = Obstacles::over(&Obstacles::of(&frame));
        let mut whole = Group::default();
        for i in 0..200 {
            let at = Point::new(f64::from(i * 37 % 120) - 10.0, f64::from(i * 53 % 80) - 10.0);
            let mut own = Group::default();
            own.mark(Mark::stroke(Shape::Line(at, at + Vec2::new(7.0, 3.0)), pen));
            own.mark(Mark::stroke(Shape::Circle { centre: at, radius: 1.5 }, pen));
            let head = vec![at, at + Vec2::new(1.0, 0.4), at + Vec2::new(1.0, -0.4)];
            own.mark(Mark { fill: Some(Tone::Ink), ..Mark::stroke(Shape::Polygon(head), pen) });
            grown.extend(&own);
            whole.group(own);
        }
        assert_eq!(grown.grid.entries(), {
            let mut at_once = Obstacles::over(&Obstacles::of(&frame));
            at_once.extend(&whole);
            at_once.grid.entries()
        });
        let whole = Obstacles::of(&whole);
        let mut costly = 0;
        for (x, y) in (0..14).flat_map(|x| (0..10).map(move |y| (x, y))) {
            let centre = (10.0 * f64::from(x) - 15.0, 9.0 * f64::from(y) - 12.0);
            let own = Rect::from_center_size(centre, (4.6, 3.0));
            let cost = whole.cost_up_to(own, f64::INFINITY);
            assert_eq!(grown.cost_up_to(own, f64::INFINITY), cost, "at {centre:?}");
            assert_eq!(grown.is_free(own), whole.is_free(own), "at {centre:?}");
            costly += usize::from(cost > 0.0);
        }
        assert!(costly > 50, "{costly}");
    }

    /// Two lines close to each other are named from outside, each on its own side.
    #[test]
    fn a_name_stands_nearer_to_its_own_line() {
        let mut ink = Group::default();
        let lines = [0.0, 1.2].map(|x| (Point::new(x, 0.0), Point::new(x, 13.0)));
        for (from, to) in lines {
            ink.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(0.25)));
        }
        let named =
            |(from, to)| Request::new(Rich::italic("A").sub("DC"), 3.3, Site::Along { from, to }, "label");
        let placed = place(&ink, &lines.map(named), None);
        let mut centres = Vec::new();
        placed.walk(&mut |node| {
            if let Node::Text(text) = node {
                centres.extend(text.boxes().into_iter().reduce(|a, b| a.union(b)).map(|own| own.center().x));
            }
        });
        assert!(centres.len() == 2 && centres[0] < 0.0 && centres[1] > 1.2, "{centres:?}");
    }

    #[test]
    fn an_optional_label_gives_way() {
        let mut ink = Group::default();
        for i in -40..40 {
            let y = f64::from(i) * 0.8;
            let line = Shape::Line(Point::new(-40.0, y), Point::new(40.0, y));
            ink.mark(Mark::stroke(line, Pen::solid(0.25)));
        }
        let site = Site::Around { at: Point::new(0.0, 0.0), radius: 0.5, toward: None };
        let mut request = Request::new(Rich::italic("a"), 4.0, site, "label");
        request.optional = true;
        assert!(place(&ink, &[request], None).children.is_empty());
    }
}
