//! Label placement: candidates with costs, a greedy pass in a fixed order, then repair passes.

use kurbo::{Point, Rect, Vec2};

use super::figure::{Group, Mark, Node, Pen, Shape, Tone, on_circle};
use super::grid::Grid;
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
/// Another named line is this much further away than a name's own, or the name might be its.
const BESIDE: f64 = 1.0;
/// Lines no further apart than this are named side by side.
const TOGETHER: f64 = 0.8;
/// Passes of repair; each label moves to its best place given all others.
const PASSES: usize = 8;
/// Moves by which a crowd is untangled: where so many do not suffice there is no room.
const MOVES: usize = 1500;
/// More labels than this that touch something are past repair.
const MOST_TOUCHING: usize = 100;

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
}

impl Request {
    /// The same with a further place where it may stand.
    #[must_use]
    pub fn or(mut self, site: Site) -> Self {
        self.sites.push(site);
        self
    }

    /// A label that must be placed.
    #[must_use]
    pub fn new(text: Rich, size: f64, site: Site, class: &'static str) -> Self {
        Self { text, size, sites: vec![site], class, ring: None, optional: false, leader: false }
    }
}

#[derive(Debug, Clone)]
struct Candidate {
    at: Point,
    boxes: Vec<Rect>,
    leader: Option<(Point, Point)>,
    /// Preference plus what the fixed ink costs.
    cost: f64,
    touches_ink: bool,
}

/// Ink that labels keep away from.
#[derive(Debug, Default)]
pub struct Obstacles {
    strokes: Vec<(Point, Point, f64)>,
    areas: Vec<Vec<Point>>,
    boxes: Vec<Rect>,
    /// Strokes, then areas, then boxes, each by its own grid.
    grids: [Grid; 3],
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

    /// Adds the ink of a group to it.
    pub fn extend(&mut self, group: &Group) {
        let more = Self::of(group);
        self.strokes.extend(more.strokes);
        self.areas.extend(more.areas);
        self.boxes.extend(more.boxes);
        self.index();
    }

    fn index(&mut self) {
        let area = |points: &[Point]| {
            let first = points.first().copied().unwrap_or_default();
            points.iter().fold(Rect::from_points(first, first), |r, p| r.union_pt(*p))
        };
        let strokes = self.strokes.iter().map(|(a, b, _)| Rect::from_points(*a, *b));
        let all = strokes.chain(self.boxes.iter().copied()).chain(self.areas.iter().map(|p| area(p)));
        let whole = all.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        self.grids = std::array::from_fn(|_| Grid::new(whole));
        for (i, (a, b, half)) in self.strokes.iter().enumerate() {
            self.grids[0].add_stroke(i, *a, *b, *half);
        }
        for (i, points) in self.areas.iter().enumerate() {
            self.grids[1].add(i, area(points));
        }
        for (i, own) in self.boxes.iter().enumerate() {
            self.grids[2].add(i, *own);
        }
    }

    fn add(&mut self, mark: &Mark) {
        if mark.backdrop {
            return;
        }
        let half = mark.pen.map_or(0.0, |pen| pen.width / 2.0);
        self.strokes.extend(mark.shape.outline().into_iter().map(|(a, b)| (a, b, half)));
        if let (Some(Tone::Ink), Shape::Polygon(points)) = (mark.fill, &mark.shape) {
            self.areas.push(points.clone());
        }
    }

    /// What a box costs: 0 where it is free, a little where it is tight, much where it touches; and
    /// whether it touches.
    #[must_use]
    pub fn cost(&self, own: Rect) -> (f64, bool) {
        let mut cost = 0.0;
        let mut touch = false;
        let tight = own.inflate(CLEARANCE, CLEARANCE);
        let mut near = Vec::new();
        // A stroke lies in the cells that it touches with its own width.
        self.grids[0].near(tight, &mut near);
        for (a, b, half) in near.iter().map(|i| &self.strokes[*i]) {
            let grown = tight.inflate(*half, *half);
            let beside = a.x.max(b.x) < grown.x0 || a.x.min(b.x) > grown.x1;
            if beside || a.y.max(b.y) < grown.y0 || a.y.min(b.y) > grown.y1 {
                continue;
            }
            if let Some((t0, t1)) = clip(*a, *b, grown) {
                let inside = (t1 - t0) * a.distance(*b);
                if clip(*a, *b, own.inflate(half + 0.08, half + 0.08)).is_some() {
                    touch = true;
                    cost += TOUCH * (1.0 + inside);
                } else {
                    cost += 12.0 + 4.0 * inside;
                }
            }
        }
        self.grids[1].near(tight, &mut near);
        for area in near.iter().map(|i| &self.areas[*i]) {
            if area.iter().any(|p| tight.contains(*p)) {
                cost += TOUCH;
                touch = true;
            }
        }
        self.grids[2].near(own.inflate(WORD, CLEARANCE), &mut near);
        for other in near.iter().map(|i| &self.boxes[*i]) {
            let (c, t) = between(own, *other);
            cost += c;
            touch |= t;
        }
        (cost, touch)
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
        (6.0, false)
    } else {
        (0.0, false)
    }
}

/// Places the labels clear of the ink in `group` and of each other, and draws them in a group of their
/// own. Returns that group; a label that must stand and finds no free place stands where it costs least.
#[must_use]
pub fn place(group: &Group, requests: &[Request], within: Option<Rect>) -> Group {
    let obstacles = Obstacles::of(group);
    let lines: Vec<Line> = requests.iter().map(|r| r.text.set(r.size)).collect();
    let anchors: Vec<(usize, Point)> = requests
        .iter()
        .enumerate()
        .filter_map(|(i, r)| match r.sites[..] {
            [Site::Around { at, .. }] => Some((i, at)),
            _ => None,
        })
        .collect();
    let lines_named: Vec<(usize, Point, Point)> = requests
        .iter()
        .enumerate()
        .filter_map(|(i, r)| match r.sites[..] {
            [Site::Along { from, to }, ..] => Some((i, from, to)),
            _ => None,
        })
        .collect();
    let strangers = Strangers::new(anchors, lines_named);
    let priced = |i: usize, reach: Reach| {
        let mut all = Vec::new();
        for (rank, site) in requests[i].sites.iter().enumerate() {
            for mut candidate in candidates(&requests[i], *site, &lines[i], reach) {
                candidate.cost += 5.0 * rank as f64;
                price(&mut candidate, *site, i, &obstacles, &strangers, within);
                all.push(candidate);
            }
        }
        all.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        all.truncate(if reach == Reach::Near { 240 } else { 1200 });
        all
    };
    let mut candidates: Vec<Vec<Candidate>> = (0..requests.len()).map(|i| priced(i, Reach::Near)).collect();

    // Those with the fewest free places choose first; among equals, those that must stand, then order.
    let mut order: Vec<usize> = (0..requests.len()).collect();
    let free = |i: usize| candidates[i].iter().filter(|c| c.cost < TOUCH).count();
    order.sort_by_key(|i| (requests[*i].optional, free(*i), *i));
    let mut standing = Standing::new(&candidates);
    for pass in 0..=PASSES {
        let mut moved = false;
        for &i in &order {
            moved |= standing.settle(i, &candidates, requests[i].optional);
        }
        if pass > 0 && (!moved || standing.touching(&order, &candidates) > MOST_TOUCHING) {
            break;
        }
    }
    standing.untangle(&order, requests, &mut candidates, &|i| priced(i, Reach::Far));
    let chosen = standing.chosen;

    let mut out = Group::new("labels");
    for (i, request) in requests.iter().enumerate() {
        let Some(candidate) = chosen[i].map(|c| &candidates[i][c]) else { continue };
        if let Some((from, to)) = candidate.leader {
            out.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(0.13)).class("leader"));
        }
        if let Some(radius) = request.ring {
            let centre = lines[i].ink_at(candidate.at).center();
            out.mark(Mark::stroke(Shape::Circle { centre, radius }, Pen::solid(0.18)).class("ring"));
        }
        lines[i].put(&mut out, candidate.at, request.class);
    }
    out
}

/// The labels as they stand.
struct Standing {
    chosen: Vec<Option<usize>>,
    /// How dearly the others pay for touching it.
    weights: Vec<f64>,
    texts: Grid,
    leaders: Grid,
}

impl Standing {
    fn new(all: &[Vec<Candidate>]) -> Self {
        let boxes = all.iter().flatten().flat_map(|c| &c.boxes).copied();
        let area = boxes.reduce(|a, b| a.union(b)).unwrap_or(Rect::ZERO);
        let (chosen, weights) = (vec![None; all.len()], vec![1.0; all.len()]);
        Self { chosen, weights, texts: Grid::new(area), leaders: Grid::new(area) }
    }

    /// In a crowd some labels still touch something. They look further away, and whoever is touched again
    /// and again becomes dearer to touch, until those in its way move.
    fn untangle(
        &mut self,
        order: &[usize],
        requests: &[Request],
        all: &mut [Vec<Candidate>],
        further: &dyn Fn(usize) -> Vec<Candidate>,
    ) {
        let mut looked: Vec<bool> = vec![false; all.len()];
        let mut moves = 0;
        while moves < MOVES {
            let touching: Vec<usize> = order.iter().copied().filter(|i| self.touches(*i, all)).collect();
            if touching.len() > MOST_TOUCHING || touching.iter().all(|i| requests[*i].optional) {
                break;
            }
            moves += touching.len();
            for &i in &touching {
                self.weights[i] += 1.0;
                if !std::mem::replace(&mut looked[i], true) {
                    self.choose(i, None, all);
                    all[i] = further(i);
                }
                self.settle(i, all, requests[i].optional);
            }
        }
        for i in order.iter().copied().filter(|i| requests[*i].optional) {
            if self.touches(i, all) {
                self.choose(i, None, all);
            }
        }
    }

    /// How many labels touch something.
    fn touching(&self, order: &[usize], all: &[Vec<Candidate>]) -> usize {
        order.iter().filter(|i| self.touches(**i, all)).count()
    }

    fn choose(&mut self, i: usize, choice: Option<usize>, all: &[Vec<Candidate>]) {
        if let Some(old) = self.chosen[i].map(|c| &all[i][c]) {
            old.boxes.iter().for_each(|own| self.texts.remove(i, *own));
            if let Some((a, b)) = old.leader {
                self.leaders.remove(i, Rect::from_points(a, b));
            }
        }
        if let Some(new) = choice.map(|c| &all[i][c]) {
            new.boxes.iter().for_each(|own| self.texts.add(i, *own));
            if let Some((a, b)) = new.leader {
                self.leaders.add_stroke(i, a, b, 0.0);
            }
        }
        self.chosen[i] = choice;
    }

    /// Moves a label to its best place given all others; whether it moved.
    fn settle(&mut self, i: usize, all: &[Vec<Candidate>], optional: bool) -> bool {
        let best = self.best(i, all, optional);
        let moved = best != self.chosen[i];
        if moved {
            self.choose(i, best, all);
        }
        moved
    }

    fn best(&self, i: usize, all: &[Vec<Candidate>], optional: bool) -> Option<usize> {
        let mut best: Option<(f64, usize)> = None;
        for (c, candidate) in all[i].iter().enumerate() {
            let limit = best.map_or(f64::INFINITY, |(cost, _)| cost);
            if candidate.cost >= limit {
                break; // sorted by cost: none of the rest can be better
            }
            let (cost, touch) = self.cost(i, candidate, all, limit);
            if optional && (touch || cost > 60.0) {
                continue;
            }
            if cost < limit {
                best = Some((cost, c));
            }
        }
        best.map(|(_, c)| c)
    }

    /// What a candidate costs among the others, and whether it touches anything; not counted further once
    /// it costs `limit`.
    fn cost(&self, i: usize, candidate: &Candidate, all: &[Vec<Candidate>], limit: f64) -> (f64, bool) {
        let mut near = Vec::new();
        for own in &candidate.boxes {
            let own = own.inflate(WORD, CLEARANCE);
            self.texts.find(own, &mut near);
            self.leaders.find(own, &mut near);
        }
        if let Some((a, b)) = candidate.leader {
            self.texts.find_along(a, b, 0.3, &mut near);
            self.leaders.find_along(a, b, 0.0, &mut near);
        }
        near.sort_unstable();
        near.dedup();
        let mut cost = candidate.cost;
        let mut touch = candidate.touches_ink;
        for j in near {
            let Some(other) = self.chosen[j].filter(|_| j != i).map(|o| &all[j][o]) else { continue };
            let (c, t) = conflict(candidate, other);
            cost += c * self.weights[j];
            touch |= t;
            if cost >= limit {
                break;
            }
        }
        (cost, touch)
    }

    fn touches(&self, i: usize, all: &[Vec<Candidate>]) -> bool {
        self.chosen[i].is_some_and(|own| self.cost(i, &all[i][own], all, f64::INFINITY).1)
    }
}

fn conflict(a: &Candidate, b: &Candidate) -> (f64, bool) {
    let mut cost = 0.0;
    let mut touch = false;
    for x in &a.boxes {
        for y in &b.boxes {
            let (c, t) = between(*x, *y);
            cost += c;
            touch |= t;
        }
    }
    for (p, q) in [(a, b), (b, a)] {
        if let Some((from, to)) = p.leader {
            for r in &q.boxes {
                if clip(from, to, r.inflate(0.3, 0.3)).is_some() {
                    cost += TOUCH;
                    touch = true;
                }
            }
            if let Some((c, d)) = q.leader
                && crossing(from, to, c, d)
            {
                cost += 100.0;
            }
        }
    }
    (cost, touch)
}

fn crossing(a: Point, b: Point, c: Point, d: Point) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).cross(r - p) > 0.0;
    side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b)
}

/// Adds what ink, strangers and the edge cost.
fn price(
    candidate: &mut Candidate,
    site: Site,
    index: usize,
    obstacles: &Obstacles,
    strangers: &Strangers,
    within: Option<Rect>,
) {
    for own in &candidate.boxes {
        let (cost, touch) = obstacles.cost(*own);
        candidate.cost += cost;
        candidate.touches_ink |= touch;
        if within.is_some_and(|w| !w.contains_rect(*own)) {
            candidate.cost += TOUCH;
            candidate.touches_ink = true;
        }
    }
    if let Some((from, to)) = candidate.leader {
        // A leader may leave its own point, so only what it crosses further out counts.
        let start = from.lerp(to, (1.5 / from.distance(to).max(1.5)).min(1.0));
        let mut near = Vec::new();
        obstacles.grids[0].near(Rect::from_points(start, to), &mut near);
        for (a, b, _) in near.iter().map(|i| &obstacles.strokes[*i]) {
            if crossing(start, to, *a, *b) {
                candidate.cost += 40.0;
            }
        }
        obstacles.grids[2].near(Rect::from_points(start, to), &mut near);
        if near.iter().any(|i| clip(start, to, obstacles.boxes[*i].inflate(0.3, 0.3)).is_some()) {
            candidate.cost += TOUCH;
            candidate.touches_ink = true;
        }
    }
    let whole = candidate.boxes.iter().copied().reduce(|a, b| a.union(b));
    if let (Site::Around { at, .. }, Some(own)) = (site, whole) {
        let near = distance(own, at);
        let mut others = Vec::new();
        if candidate.leader.is_none() {
            strangers.point_grid.near(own.inflate(near + 1.0, near + 1.0), &mut others);
        }
        let others = others.into_iter().map(|i| strangers.points[i]);
        for (_, stranger) in others.filter(|(j, p)| *j != index && p.distance(at) > 0.2) {
            let far = distance(own, stranger);
            if far < near + 1.0 {
                candidate.cost += 25.0 + 10.0 * (near + 1.0 - far);
            }
            if far < near {
                candidate.cost += MISREAD;
            }
        }
    }
    if let (Site::Along { from, to }, Some(own)) = (site, whole) {
        let near = gap(own, from, to);
        let mut others = Vec::new();
        strangers.line_grid.near(own.inflate(near + BESIDE, near + BESIDE), &mut others);
        let others = others.into_iter().map(|i| strangers.lines[i]);
        for (_, a, b) in others.filter(|(j, ..)| *j != index && candidate.leader.is_none()) {
            let far = gap(own, a, b);
            if far < near + BESIDE {
                candidate.cost += 4.0 + 6.0 * (near + BESIDE - far);
            }
            // Of two lines that nearly fall together the names stand beside both.
            if far + TOGETHER < near {
                candidate.cost += MISREAD;
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
    let d = b - a;
    let t = ((p - a).dot(d) / d.hypot2().max(1e-12)).clamp(0.0, 1.0);
    a.lerp(b, t).distance(p)
}

fn distance(r: Rect, p: Point) -> f64 {
    let dx = (r.x0 - p.x).max(p.x - r.x1).max(0.0);
    let dy = (r.y0 - p.y).max(p.y - r.y1).max(0.0);
    libm::hypot(dx, dy)
}

fn candidates(request: &Request, site: Site, line: &Line, how_far: Reach) -> Vec<Candidate> {
    let half = match request.ring {
        Some(radius) => Vec2::new(radius, radius),
        None => Vec2::new(line.ink.width() / 2.0, line.ink.height() / 2.0),
    };
    let middle = line.ink.center().to_vec2();
    let stand = |centre: Point, cost: f64, leader: Option<Point>| {
        let at = centre - middle;
        let boxes = match request.ring {
            Some(_) => vec![Rect::from_center_size(centre, (2.0 * half.x, 2.0 * half.y))],
            None => line.boxes_at(at),
        };
        let leader = leader.map(|from| {
            let to = if let Some(radius) = request.ring {
                let d = from - centre;
                centre + d * (radius / d.hypot().max(1e-9)).min(1.0)
            } else {
                let own = Rect::from_center_size(centre, (2.0 * half.x + 0.8, 2.0 * half.y + 0.8));
                clip(from, centre, own).map_or(centre, |(t, _)| from.lerp(centre, t))
            };
            (from, to)
        });
        Candidate { at, boxes, leader, cost, touches_ink: false }
    };
    let mut all = Vec::new();
    match site {
        Site::Around { at, radius, toward } => {
            for (ring, gap) in [0.6, 1.1, 1.8, 2.8, 4.2].into_iter().enumerate() {
                for k in 0..24 {
                    let angle = f64::from(k) * (std::f64::consts::TAU / 24.0);
                    let wanted = toward.unwrap_or(std::f64::consts::FRAC_PI_4);
                    let away = 1.0 - libm::cos(angle - wanted);
                    let weight = if toward.is_some() { 2.0 } else { 0.6 };
                    let cost = 3.5 * ring as f64 + weight * away;
                    all.push(stand(beside(at, angle, radius + gap, half), cost, None));
                }
            }
            if request.leader || how_far == Reach::Far {
                for (ring, gap) in leaders([5.0, 7.0, 9.5, 12.0, 15.0], how_far) {
                    for k in 0..24 {
                        let angle = f64::from(k) * (std::f64::consts::TAU / 24.0);
                        let centre = beside(at, angle, radius + gap, half);
                        let from = on_circle(at, radius + 0.3, angle);
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
                            let start = foot + normal * (side * 0.4);
                            all.push(stand(centre, 30.0 + taste + 4.0 * ring as f64, Some(start)));
                        }
                    }
                }
            }
        }
    }
    all
}

/// The lengths of leaders, with their ranks: in a crowd they go on to half a page.
fn leaders<const N: usize>(near: [f64; N], reach: Reach) -> impl Iterator<Item = (usize, f64)> {
    const FAR: [f64; 12] = [18.0, 21.0, 24.0, 28.0, 32.0, 37.0, 43.0, 50.0, 58.0, 67.0, 77.0, 90.0];
    let far = if reach == Reach::Far { &FAR[..] } else { &[] };
    near.into_iter().chain(far.iter().copied()).enumerate()
}

/// Centre of a box that stands in this direction from a point with a clear gap between them.
fn beside(at: Point, angle: f64, gap: f64, half: Vec2) -> Point {
    let (sin, cos) = libm::sincos(angle);
    let x = half.x * (cos * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
    let y = half.y * (sin * std::f64::consts::SQRT_2).clamp(-1.0, 1.0);
    Point::new(at.x + gap * cos + x, at.y - gap * sin - y)
}

#[cfg(test)]
mod tests {
    use super::*;
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
