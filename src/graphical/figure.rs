//! Places that the scene states by two loci, with ruler and compass, before the first step of the skeleton.
//!
//! A circle is struck about its point, a ray drawn with the protractor, a square line with the set square. The circle
//! from which a segment is seen at an angle has its centre on the perpendicular bisector of the segment, and on the
//! perpendicular to the tangent, which makes that angle with the segment at its end (Euclid III.32).

use std::borrow::Cow;

use crate::board::{Board, Circle, Direction, Line, Pair, Point, Side, Tape};
use crate::given::Given;
use crate::mechanism::statement::{Locus, Standing, Statement};
use crate::mechanism::structure::Structure;
use crate::mechanism::{Guide, LinkId, Mechanism, PointId};

use super::construction::{Act, ConstructionLine};
use super::draughtsman::Draughtsman;
use super::missing::Missing;
use super::pose::Track;
use super::position::{TOUCHES, chooses};
use super::{DrawError, Unplaced};

/// A stated place may differ from a given dimension or guide by this part of the mechanism's size.
const ROUNDING: f64 = 1e-6;
/// Lines that cross at a smaller angle are parallel, radians.
const PARALLEL: f64 = 1e-12;

/// A locus on the skeleton.
#[derive(Clone, Copy)]
enum Drawn {
    Line(Line),
    Circle(Circle),
}

/// Where two loci meet.
enum Meets {
    One(Point, f64),
    Two(Pair),
}

/// The mechanism with its stated places as they are drawn, for whoever leaves the scene's instant: each counts as
/// placed with its bound, or as a hint where the rest of the scene says where it is.
///
/// # Errors
/// [`DrawError::Unplaced`] or [`DrawError::Ambiguous`], where a point cannot be drawn from what is stated.
pub(crate) fn standing(mechanism: &Mechanism) -> Result<Cow<'_, Mechanism>, DrawError> {
    if mechanism.statements.is_empty() {
        return Ok(Cow::Borrowed(mechanism));
    }
    let scales = super::provisional_scales(mechanism);
    let structure = Structure::default();
    let mut d = Draughtsman::new(Board::new(Tape::default()), mechanism, &structure, scales);
    let places = draw_all(&mut d)?;
    let mut given = Vec::with_capacity(places.len());
    for at in places {
        let [x, y] = d.in_world(at);
        let world = [x, y].map(|amount| {
            let error = d.board.tape().bound(amount.mark());
            Given::within(amount.value(), error)
        });
        given.push(world);
    }
    let of = |statement: &Statement| {
        let index = mechanism.statements.iter().position(|other| other.point == statement.point)?;
        given.get(index).copied()
    };
    Ok(Cow::Owned(mechanism.with_places(of)))
}

/// Draws the stated places, each after those on which it hangs.
pub(super) fn draw(d: &mut Draughtsman<'_>) -> Result<(), DrawError> {
    if d.mechanism.statements.is_empty() {
        return Ok(());
    }
    d.board.purpose("stated place");
    let places = draw_all(d)?;
    for (statement, at) in d.mechanism.statements.iter().zip(places) {
        if statement.stands() {
            continue;
        }
        // From here on the point is where the rest of the scene says.
        d.pricked[statement.point.0] = None;
        if statement.standing == Standing::Hint {
            d.stated_hints[statement.point.0] = Some(at);
        }
    }
    Ok(())
}

fn draw_all(d: &mut Draughtsman<'_>) -> Result<Vec<Point>, DrawError> {
    let mut places = Vec::with_capacity(d.mechanism.statements.len());
    for index in 0..d.mechanism.statements.len() {
        let statement = d.mechanism.statements[index];
        let at = d.stated_place(&statement)?;
        d.nothing_missing()?;
        d.pricked[statement.point.0] = Some(at);
        places.push(at);
    }
    Ok(places)
}

/// What stated places may miss by what they must lie on, as rounding, paper millimetres: at the scale of a first drawing the
/// longest known length is 100 mm.
pub(super) fn allowed(d: &Draughtsman<'_>) -> f64 {
    ROUNDING * 100.0 * super::provisional_scales(d.mechanism).length() / d.scales.length()
}

impl Draughtsman<'_> {
    /// The place of a point by what a figure states of it.
    fn stated_place(&mut self, statement: &Statement) -> Result<Point, DrawError> {
        let of = statement.point;
        let stated = match statement.laid_off() {
            Some((from, direction, distance)) => {
                let start = self.standing_at(from);
                let angle = self.board.angle(direction);
                let along = self.board.protractor(angle);
                let length = self.on_paper(distance);
                let (angle, length_value) = (direction.value, distance.value);
                self.act(Act::LayOffPlace { from, to: of, angle, length: length_value });
                self.board.lay_off(start, along, length)
            }
            None => {
                let near = statement.near.map(|near| self.world_on_paper(near));
                self.meet_loci(of, &statement.loci, near, true)?
            }
        };
        let settled = match statement.standing {
            Standing::Stated | Standing::Hint | Standing::Driven => return Ok(stated),
            Standing::Onto(locus) => self.brought_onto(&locus, stated),
            Standing::AtMeet(loci) => match self.meet_clearly(of, &loci, stated) {
                // What holds the point besides only touches, or by rounding crosses twice about the stated place: along it
                // that tells where the point is.
                Err(
                    error @ (DrawError::Unplaced { why: Unplaced::Touches | Unplaced::Apart, .. }
                    | DrawError::Ambiguous { .. }),
                ) => {
                    let on_first = self.brought_onto(&loci[0], stated);
                    let on_second = self.brought_onto(&loci[1], on_first);
                    self.is_at(of, on_second, on_first).map_err(|_| error)?;
                    on_first
                }
                met => met?,
            },
        };
        self.nothing_missing()?;
        // What is measured here is no part of the drawing.
        self.board.tape().aside(true);
        let agrees = self.is_at(of, settled, stated);
        self.board.tape().aside(false);
        agrees.map(|()| settled)
    }

    /// Where two loci that hold a point besides its statement meet next to where it is stated. Where they may be one for what
    /// their numbers leave open, they only touch: the meet may be anywhere along them.
    fn meet_clearly(&mut self, of: PointId, loci: &[Locus; 2], stated: Point) -> Result<Point, DrawError> {
        let met = self.meet_loci(of, loci, Some(stated.value()), false)?;
        if self.is_told(met) {
            Ok(met)
        } else {
            Err(DrawError::Unplaced { point: of, why: Unplaced::Touches })
        }
    }

    /// Whether the drawing tells where a point is.
    pub(super) fn is_told(&mut self, at: Point) -> bool {
        self.board.tape().aside(true);
        let pole = self.board.origin();
        let marks = self.board.between(pole, at).map(|mm| mm.mark());
        self.board.tape().aside(false);
        self.tells(&marks)
    }

    /// Whether the drawing tells what was measured: no divisor or half chord behind it may be zero for its error.
    fn tells(&mut self, measured: &[u32]) -> bool {
        let tape = self.board.tape();
        !tape.keeps() || measured.iter().all(|mark| tape.weakness(*mark).is_none())
    }

    /// The point of a locus that is met square on from a place.
    fn brought_onto(&mut self, locus: &Locus, from: Point) -> Point {
        let track = match self.locus(locus) {
            Drawn::Line(line) => Track::Straight(line),
            Drawn::Circle(circle) => Track::Arc(circle),
        };
        self.brought_to(track, from)
    }

    /// The point of a track that is met square on from a place.
    pub(super) fn brought_to(&mut self, track: Track, from: Point) -> Point {
        match track {
            Track::Straight(line) => {
                let [along, _] = self.board.square_off(line, from);
                self.board.lay_off(line.through, line.along, along)
            }
            Track::Arc(circle) => {
                let reason = self.reason(&[]);
                let (along, _) = self.board.toward(circle.centre, from, reason);
                self.board.lay_off(circle.centre, along, circle.radius)
            }
        }
    }

    /// Refuses a point that is stated beside where the rest of the scene puts it, by more than rounding and what the rooms of
    /// placed points leave open. A place that the drawing does not tell contradicts nothing.
    ///
    /// # Errors
    /// [`DrawError::Unplaced`].
    pub(super) fn is_at(&mut self, of: PointId, stands: Point, stated: Point) -> Result<(), DrawError> {
        let apart = self.board.distance(stands, stated);
        let miss = apart.value();
        let contradicts = miss > allowed(self) && miss > allowed(self) + self.left_open(&[apart.mark()]);
        if contradicts && self.tells(&[apart.mark()]) {
            let by = miss * self.scales.length();
            return Err(DrawError::Unplaced { point: of, why: Unplaced::Beside { by } });
        }
        Ok(())
    }

    /// World coordinates as millimetres of the skeleton, for hints.
    fn world_on_paper(&self, world: [f64; 2]) -> [f64; 2] {
        let origin = self.origin_of_space().map(|g| g.value);
        [0, 1].map(|k| (world[k] - origin[k]) / self.scales.length())
    }

    fn on_paper(&mut self, length: Given) -> crate::board::Mm {
        let scale = self.length_scale();
        let amount = self.board.amount(length);
        self.board.to_paper(amount, scale)
    }

    /// A point that stands before the skeleton is begun.
    fn standing_at(&mut self, point: PointId) -> Point {
        match self.world_place(point) {
            Some(at) => at,
            None => self.no_point(Missing::Place(point)),
        }
    }

    /// Where two loci meet; of two places the one next to `near`, millimetres of the skeleton.
    fn meet_loci(
        &mut self,
        of: PointId,
        loci: &[Locus; 2],
        near: Option<[f64; 2]>,
        told: bool,
    ) -> Result<Point, DrawError> {
        let reason = self.reason(&[]);
        let drawn = [self.locus(&loci[0]), self.locus(&loci[1])];
        let apart = DrawError::Unplaced { point: of, why: Unplaced::Apart };
        let touches = DrawError::Unplaced { point: of, why: Unplaced::Touches };
        let meets = match drawn {
            [Drawn::Line(first), Drawn::Line(second)] => {
                let meet = self.board.meet_lines(first, second, reason);
                if meet.crossing < PARALLEL {
                    return Err(touches);
                }
                Meets::One(meet.at, meet.crossing)
            }
            [Drawn::Line(line), Drawn::Circle(circle)] | [Drawn::Circle(circle), Drawn::Line(line)] => {
                Meets::Two(self.board.meet_line_circle(line, circle, reason).map_err(|_| apart.clone())?)
            }
            [Drawn::Circle(first), Drawn::Circle(second)] => {
                Meets::Two(self.board.meet_circles(first, second, reason).map_err(|_| apart.clone())?)
            }
        };
        let (at, crossing) = match meets {
            Meets::One(at, crossing) => {
                if !self.lies_on(loci, at.value()) {
                    return Err(apart);
                }
                (at, crossing)
            }
            Meets::Two(pair) if pair.tangent => return Err(touches),
            // Of what holds a stated point besides, that is left to the stated place.
            Meets::Two(pair) if !told && pair.crossing < TOUCHES => return Err(touches),
            Meets::Two(pair) => {
                let sides = [Side::First, Side::Second];
                let places = sides.map(|side| self.board.look(&pair, side));
                let mut fine = places.map(|at| self.lies_on(loci, at));
                for end in Locus::blind_ends(loci) {
                    // One of the meets is that end, found once more.
                    let [x, y] = self.standing_at(end).value();
                    let [first, second] = places.map(|at| libm::hypot(at[0] - x, at[1] - y));
                    fine[usize::from(second < first)] = false;
                }
                let side = match fine {
                    [false, false] => return Err(apart),
                    [true, false] => Side::First,
                    [false, true] => Side::Second,
                    [true, true] => self.next_to(of, places, near)?,
                };
                (self.board.take(pair, side), pair.crossing)
            }
        };
        if told {
            self.tell_of_place(of, loci, &drawn, at);
            self.act(Act::MarkIntersection { point: of, crossing });
        }
        Ok(at)
    }

    /// Which of two places a hint chooses.
    fn next_to(&self, of: PointId, places: [[f64; 2]; 2], near: Option<[f64; 2]>) -> Result<Side, DrawError> {
        let per_mm = self.scales.length();
        let square = |at: [f64; 2], near: [f64; 2]| {
            let [x, y] = [0, 1].map(|k| (at[k] - near[k]) * per_mm);
            x * x + y * y
        };
        if let Some(near) = near {
            let [first, second] = places.map(|at| square(at, near));
            if chooses(first, second, per_mm) {
                return Ok(Side::First);
            }
            if chooses(second, first, per_mm) {
                return Ok(Side::Second);
            }
        }
        let origin = self.origin_of_space().map(|g| g.value);
        let [first, second] = places.map(|at| [0, 1].map(|k| origin[k] + at[k] * per_mm));
        Err(DrawError::Ambiguous { pin: of, first, second })
    }

    /// Whether a point on the lines of both loci is on the loci: ahead on a ray, on the arc of an angle.
    fn lies_on(&mut self, loci: &[Locus; 2], at: [f64; 2]) -> bool {
        loci.iter().all(|locus| match locus {
            Locus::Ray { from, direction } => {
                let [x, y] = self.standing_at(*from).value();
                let (sin, cos) = libm::sincos(direction.value);
                (at[0] - x) * cos + (at[1] - y) * sin > 0.0
            }
            Locus::Sees { ends, angle } if !locus.is_whole() => {
                // On the same side of the segment as the arc: to its left where the angle is less than half a turn ccw.
                let [p, q] = ends.map(|end| self.standing_at(end).value());
                let left = (q[0] - p[0]) * (at[1] - p[1]) - (q[1] - p[1]) * (at[0] - p[0]);
                left * libm::sin(angle.value) > 0.0
            }
            Locus::Sees { .. } | Locus::Circle { .. } | Locus::Square { .. } | Locus::On(_) => true,
        })
    }

    fn locus(&mut self, locus: &Locus) -> Drawn {
        match *locus {
            Locus::Circle { centre, radius } => {
                let centre = self.standing_at(centre);
                Drawn::Circle(Circle { centre, radius: self.on_paper(radius) })
            }
            Locus::Ray { from, direction } => {
                let through = self.standing_at(from);
                let angle = self.board.angle(direction);
                Drawn::Line(Line { through, along: self.board.protractor(angle) })
            }
            Locus::Square { through, to } => {
                let [from, to] = to.map(|end| self.standing_at(end));
                let reason = self.reason(&[]);
                let (along, _) = self.board.toward(from, to, reason);
                let through = self.standing_at(through);
                Drawn::Line(Line { through, along: self.board.quarter_turn(along) })
            }
            Locus::Sees { ends, angle } => Drawn::Circle(self.circle_that_sees(ends, angle)),
            Locus::On(path) => match self.own_line(&Guide { link: LinkId::FRAME, path }) {
                Track::Straight(line) => Drawn::Line(line),
                Track::Arc(circle) => Drawn::Circle(circle),
            },
        }
    }

    /// The circle from which a segment is seen at an angle.
    fn circle_that_sees(&mut self, ends: [PointId; 2], angle: Given) -> Circle {
        let reason = self.reason(&[]);
        let [first, second] = ends.map(|end| self.standing_at(end));
        let (along, distance) = self.board.toward(first, second, reason);
        // At the first end the tangent makes the angle with the segment, on the side away from the arc.
        let by = self.board.angle(-angle);
        let tangent = self.board.turned(along, by);
        let normal = Line { through: first, along: self.board.quarter_turn(tangent) };
        let middle = self.middle(first, along, distance);
        let bisector = Line { through: middle, along: self.board.quarter_turn(along) };
        let centre = self.board.meet_lines(normal, bisector, reason).at;
        Circle { centre, radius: self.board.distance(centre, first) }
    }

    /// Half the way along a segment, with the dividers.
    fn middle(&mut self, from: Point, along: Direction, distance: crate::board::Mm) -> Point {
        let half = self.board.half(distance);
        self.board.step_off(from, along, half)
    }

    /// Tells how a stated place was found, and draws the lines that found it.
    fn tell_of_place(&mut self, of: PointId, loci: &[Locus; 2], drawn: &[Drawn; 2], at: Point) {
        let (at, step) = (at.value(), self.step_index());
        for (locus, drawn) in loci.iter().zip(drawn) {
            self.act(match *locus {
                Locus::Circle { centre, radius } => Act::StrikeArc { centre, to: of, radius: radius.value },
                Locus::Ray { from, direction } => Act::DrawStatedRay { from, to: of, angle: direction.value },
                Locus::Square { through, to } => Act::DrawSquare { through, to },
                Locus::Sees { ends, angle } => Act::DrawSeeing { ends, angle: angle.value },
                Locus::On(_) => Act::DrawPath { point: of },
            });
            self.space_line(match drawn {
                Drawn::Line(line) => {
                    ConstructionLine::Ray { from: line.through.value(), to: at, claim: None, step }
                }
                Drawn::Circle(circle) => ConstructionLine::Arc {
                    centre: circle.centre.value(),
                    radius: circle.radius.value(),
                    at,
                    step,
                },
            });
        }
    }
}
