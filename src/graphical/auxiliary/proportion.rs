//! The third proportional on a line, by two circles and their common chord.

use crate::board::{Circle, Direction, Line, Point, Side};

use super::super::draughtsman::Draughtsman;
use super::{Proportion, StrokeRole};

/// Where a third proportional ends, and the direction square to its line.
pub(super) type Cut = (Point, Direction);

impl Draughtsman<'_> {
    /// On the line from `start` to `end` the point C with start–C : start–through = start–through : start–end, and
    /// the direction square to the line.
    ///
    /// The circle on start–end as diameter and the circle about `start` through `through` have a common chord: it is
    /// square to the line and cuts it in C. Where `through` lies further out than `end` the circles do not
    /// meet: the line square at `end` meets the second circle, and the tangent there meets the line in C.
    pub(super) fn third_proportional(
        &mut self,
        start: Point,
        end: Point,
        through: Point,
        reason: crate::board::Reason,
    ) -> (Cut, Proportion) {
        let (along, whole) = self.board.toward(start, end, reason);
        let line = Line { through: start, along };
        let square = self.board.quarter_turn(along);
        let opening = self.board.distance(start, through);
        let about = Circle { centre: start, radius: opening };
        let middle = self.board.middle(start, end);
        let half = self.board.half(whole);
        let diameter = Circle { centre: middle, radius: half };
        self.aux_circle(start, opening.value(), StrokeRole::Construction);
        if let Ok(pair) = self.board.meet_circles(about, diameter, reason) {
            self.aux_circle(middle, half.value(), StrokeRole::Construction);
            let chord = self.board.common_chord(about, diameter, reason);
            let ends = [Side::First, Side::Second].map(|side| self.board.look(&pair, side));
            self.note_chord(ends);
            return ((chord.through, chord.along), Proportion::Chord);
        }
        let upright = Line { through: end, along: square };
        let Ok(pair) = self.board.meet_line_circle(upright, about, reason) else {
            // The circles touch within their errors, and neither construction tells on which side.
            return ((self.board.nowhere(reason), square), Proportion::Tangent);
        };
        let touch = self.board.take(pair, Side::First);
        let (radius, _) = self.board.toward(start, touch, reason);
        let tangent = self.board.quarter_turn(radius);
        let meet = self.board.meet_lines(line, Line { through: touch, along: tangent }, reason);
        self.aux_line(end, touch, StrokeRole::Construction, None);
        self.aux_line(start, touch, StrokeRole::Construction, None);
        self.aux_line(touch, meet.at, StrokeRole::Construction, None);
        self.aux_square(end, start, touch);
        self.aux_square(touch, start, meet.at);
        ((meet.at, square), Proportion::Tangent)
    }
}
