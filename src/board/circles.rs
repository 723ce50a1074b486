//! What the draughtsman draws with circles and set square besides their meets: common chords, feet, middles.

use super::tape::{Operation, Reason};
use super::{Board, Circle, Line, Num, Point};

impl Board {
    /// The common chord of two circles, through its foot on the line of centres and square to it.
    ///
    /// The foot is found from both radii without the root of the half chord, so that it is as good where one
    /// circle has shrunk to a point of the other as where they cross well. Circles that do not meet have a line
    /// of equal powers in its place.
    pub fn common_chord(&mut self, first: Circle, second: Circle, reason: Reason) -> Line {
        let (toward, distance) = self.toward(first.centre, second.centre, reason);
        let (d, r1, r2) = (distance.0, first.radius.0, second.radius.0);
        // (d + (r1 − r2)(r1 + r2)/d) / 2 from the first centre.
        let gap = self.sub(r1, r2);
        let sum = self.add(r1, r2);
        let product = self.mul(gap, sum);
        let quotient = self.div(product, d, reason);
        let twice = self.add(d, quotient);
        let along = super::Mm(self.times(twice, 0.5));
        let through = self.shifted(first.centre, toward, along);
        let through = self.stroke(Operation::Foot, through);
        Line { through, along: self.quarter_turn(toward) }
    }

    /// The foot of the perpendicular from a point to a line, with the set square.
    pub fn foot(&mut self, line: Line, point: Point) -> Point {
        let [along, _] = self.square_off(line, point);
        let foot = self.shifted(line.through, line.along, along);
        self.stroke(Operation::Foot, foot)
    }

    /// The middle between two points.
    pub fn middle(&mut self, a: Point, b: Point) -> Point {
        let half = |d: &mut Self, p: Num, q: Num| {
            let sum = d.add(p, q);
            d.times(sum, 0.5)
        };
        let point = Point { x: half(self, a.x, b.x), y: half(self, a.y, b.y) };
        self.stroke(Operation::Divide, point)
    }

    /// Whether a length is zero as far as its own error tells.
    pub fn is_nothing(&mut self, length: super::Mm) -> bool {
        self.vanishes(length.0)
    }

    /// Whether an amount is zero as far as its own error tells.
    pub fn is_no_amount(&mut self, amount: super::Amount) -> bool {
        self.vanishes(amount.0)
    }

    /// A length of the draughtsman's own choice.
    pub fn millimetres(&mut self, length: f64) -> super::Mm {
        super::Mm(self.exact(length))
    }

    /// A multiple of a length; a negative one points the other way.
    pub fn multiple(&mut self, length: super::Mm, factor: f64) -> super::Mm {
        super::Mm(self.times(length.0, factor))
    }

    /// Half of a length.
    pub fn half(&mut self, length: super::Mm) -> super::Mm {
        super::Mm(self.times(length.0, 0.5))
    }
}
