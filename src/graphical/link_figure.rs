//! A link's own figure, drawn aside from its given dimensions: the lengths and offsets by which its points
//! are transferred to the skeleton.

use crate::board::{Amount, Circle, Line, Mm, Point, Ratio, Side};
use crate::mechanism::{Form, Link, LinkId, PointId, Sense};

use super::construction::Act;
use super::draughtsman::Draughtsman;
use super::missing::Missing;

/// The lengths that a link's form states between points that count, for a first idea of the mechanism's size.
pub(super) fn given_lengths(link: &Link, counts: &dyn Fn(PointId) -> bool) -> Vec<f64> {
    let counted = |index: usize| link.points.get(index).is_none_or(|point| counts(*point));
    let some = |ends: [usize; 2], length: f64| ends.into_iter().all(counted).then_some(length);
    match &link.form {
        Form::Length(l) => vec![l.value],
        Form::Line(positions) => {
            let values = || positions.iter().enumerate().filter(|(i, _)| counted(*i)).map(|(_, p)| p.value);
            vec![(values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)).max(0.0)]
        }
        Form::Sides { first_second, second_third, third_first, .. } => {
            let sides = [([0, 1], first_second), ([1, 2], second_third), ([2, 0], third_first)];
            sides.into_iter().filter_map(|(ends, side)| some(ends, side.value)).collect()
        }
        Form::Arms { second, third, .. } => {
            let arms = [([0, 1], second), ([0, 2], third)];
            arms.into_iter().filter_map(|(ends, arm)| some(ends, arm.value)).collect()
        }
        Form::Shape(points) => {
            let points = points.iter().enumerate().filter(|(index, _)| counted(*index));
            points.flat_map(|(_, p)| [p[0].value, p[1].value]).collect()
        }
        Form::Placed | Form::Single => Vec::new(),
    }
}

impl Draughtsman<'_> {
    fn index_in(&self, link: LinkId, point: PointId) -> Option<usize> {
        self.mechanism.link(link).points.iter().position(|&p| p == point)
    }

    /// The own figure of a link with dimensions of its own, drawn once.
    fn figure(&mut self, link: LinkId) -> Vec<Point> {
        if let Some(points) = &self.figures[link.0] {
            return points.clone();
        }
        let before = self.board.purpose("own figure of a link");
        let scale = self.length_scale();
        let form = &self.mechanism.link(link).form;
        let reason = self.reason(&[link]);
        let board = &mut self.board;
        let origin = board.origin();
        let right = board.rightward();
        let mm = |board: &mut crate::board::Board, given| {
            let amount = board.amount(given);
            board.to_paper(amount, scale)
        };
        let points = match form {
            Form::Length(length) => {
                let l = mm(board, *length);
                vec![origin, board.step_off(origin, right, l)]
            }
            Form::Line(positions) => positions
                .iter()
                .map(|&p| {
                    let at = mm(board, p);
                    board.step_off(origin, right, at)
                })
                .collect(),
            Form::Sides { first_second, second_third, third_first, turn } => {
                let base = mm(board, *first_second);
                let second = board.step_off(origin, right, base);
                let about_first = Circle { centre: origin, radius: mm(board, *third_first) };
                let about_second = Circle { centre: second, radius: mm(board, *second_third) };
                let side = if *turn == Sense::Ccw { Side::First } else { Side::Second };
                // The scene room has checked the triangle inequality; a flat triangle is a tangency.
                let third = match board.meet_circles(about_first, about_second, reason) {
                    Ok(pair) => board.take(pair, side),
                    Err(_) => {
                        let behind = second_third.value > first_second.value.max(third_first.value);
                        let outward = if behind { board.reverse(right) } else { right };
                        board.step_off(origin, outward, about_first.radius)
                    }
                };
                vec![origin, second, third]
            }
            Form::Arms { second, third, angle } => {
                let l2 = mm(board, *second);
                let l3 = mm(board, *third);
                let angle = board.angle(*angle);
                let arm = board.protractor(angle);
                vec![origin, board.step_off(origin, right, l2), board.lay_off(origin, arm, l3)]
            }
            Form::Shape(points) => points
                .iter()
                .map(|p| {
                    let x = mm(board, p[0]);
                    let y = mm(board, p[1]);
                    board.prick(x, y)
                })
                .collect(),
            Form::Single => vec![origin],
            // Its points stand in the world as given: see `own`.
            Form::Placed => Vec::new(),
        };
        let mut points = points;
        for own in &self.mechanism.link(link).extra {
            let [x, y] = own.map(|given| mm(board, given));
            points.push(board.prick(x, y));
        }
        self.board.purpose(before);
        self.figures[link.0] = Some(points.clone());
        points
    }

    /// A point of the link's own figure. The own coordinates of the frame, and of a link dimensioned by placement,
    /// are the world's: there the given places stand before any step is drawn, and the skeleton is their figure.
    pub(super) fn own(&mut self, link: LinkId, point: PointId) -> Point {
        let found = if self.drawn_in_world(link) {
            self.world_place(point)
        } else {
            let index = self.index_in(link, point);
            index.and_then(|index| self.figure(link).get(index).copied())
        };
        match found {
            Some(own) => own,
            None => self.no_point(Missing::OwnPoint(link, point)),
        }
    }

    /// The real distance of two points of a link: as given, or measured and said so.
    pub(super) fn length(&mut self, link: LinkId, p: PointId, q: PointId) -> Amount {
        let mut known = self.length_at[link.0].iter().rev().filter_map(|at| self.lengths.get(*at));
        let same = |(l, a, b, _): &&(LinkId, PointId, PointId, Amount)| {
            *l == link && ((*a, *b) == (p, q) || (*b, *a) == (p, q))
        };
        if let Some(&(.., length)) = known.find(same) {
            return length;
        }
        let ends = self.index_in(link, p).zip(self.index_in(link, q)).map(|(i, j)| (i.min(j), i.max(j)));
        let form = &self.mechanism.link(link).form;
        let given = match (form, ends) {
            (Form::Length(l), Some((0, 1))) => Some(*l),
            (Form::Sides { first_second, .. }, Some((0, 1))) => Some(*first_second),
            (Form::Sides { second_third, .. }, Some((1, 2))) => Some(*second_third),
            (Form::Sides { third_first, .. }, Some((0, 2))) => Some(*third_first),
            (Form::Arms { second, .. }, Some((0, 1))) => Some(*second),
            (Form::Arms { third, .. }, Some((0, 2))) => Some(*third),
            _ => None,
        };
        let on_line = match (form, ends) {
            (Form::Line(positions), Some((i, j))) => positions.get(i).copied().zip(positions.get(j).copied()),
            _ => None,
        };
        let length = match (given, on_line) {
            (Some(given), _) => self.board.amount(given),
            (None, Some((a, b))) => {
                let (a, b) = (self.board.amount(a), self.board.amount(b));
                let signed = self.board.difference(b, a);
                self.board.magnitude(signed)
            }
            (None, None) => {
                let (a, b) = (self.own(link, p), self.own(link, q));
                let mm = self.board.distance(a, b);
                let scale = self.length_scale();
                let value = self.board.read(mm, scale);
                self.act(Act::MeasureLength { from: p, to: q, mm: mm.value(), value: value.value() });
                value
            }
        };
        let at = self.lengths.len();
        self.length_at[link.0].retain(|known| *known < at);
        self.length_at[link.0].push(at);
        self.lengths.push((link, p, q, length));
        length
    }

    /// Where `point` stands against the base `p`→`q` in the link's own figure: along and across (left
    /// positive), with the set square.
    pub(super) fn offsets(&mut self, link: LinkId, p: PointId, q: PointId, point: PointId) -> [Mm; 2] {
        let (a, b, c) = (self.own(link, p), self.own(link, q), self.own(link, point));
        let reason = self.reason(&[link]);
        let (along, _) = self.board.toward(a, b, reason);
        self.board.square_off(Line { through: a, along }, c)
    }

    /// The offsets of [`Self::offsets`] as parts of the base.
    pub(super) fn proportions(&mut self, link: LinkId, p: PointId, q: PointId, point: PointId) -> [Ratio; 2] {
        let [along, across] = self.offsets(link, p, q, point);
        let (a, b) = (self.own(link, p), self.own(link, q));
        let base = self.board.distance(a, b);
        let reason = self.reason(&[link]);
        [self.board.ratio(along, base, reason), self.board.ratio(across, base, reason)]
    }

    /// Whether the link is straight by its form, so that its images are divided, not constructed.
    pub(super) fn is_straight(&self, link: LinkId) -> bool {
        let link = self.mechanism.link(link);
        matches!(link.form, Form::Line(_) | Form::Length(_)) && link.extra.is_empty()
    }
}
