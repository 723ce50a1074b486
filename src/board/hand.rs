//! The draughtsman's own hand: pencil, ruler and set square instead of an arithmetic.
//!
//! Every length that is laid off, every direction that is drawn and every reading slips by up to the hand's
//! error. What that does to an answer is found in two ways: as a bound, by one sweep back over the tape with
//! the slips in the place of the roundings; and as a distribution, by many draughtsmen with dice.

use crate::lots::Lots;

/// What a human hand does with a pencil; each can slip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Pencil {
    /// Lays off a length, pricks a coordinate, sets the compass.
    Length,
    /// Draws a line in a direction.
    Direction,
    /// Reads a length off.
    Reading,
    /// Reads an angle off.
    AngleReading,
}

/// How exactly a human draws and reads. None of his slips is larger.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Hand {
    /// Slip of a laid-off length, of a pricked coordinate, of the compass's opening and of a reading,
    /// millimetres of paper.
    pub length: f64,
    /// Slip of a drawn direction and of an angle that is read, radians.
    pub angle: f64,
}

impl Hand {
    /// The largest slip in an act, millimetres or radians.
    pub(super) fn slip(self, kind: Pencil) -> f64 {
        match kind {
            Pencil::Length | Pencil::Reading => self.length,
            Pencil::Direction | Pencil::AngleReading => self.angle,
        }
    }
}

/// The dice of a draughtsman: each slip is uniform between its limits. The same seed draws the same drawing
/// on every machine.
#[derive(Debug, Clone)]
pub(super) struct Dice {
    lots: Lots,
    hand: Hand,
}

impl Dice {
    /// The dice of the draughtsman of this number.
    pub(super) fn new(hand: Hand, seed: u64) -> Self {
        Self { lots: Lots::new(seed.wrapping_mul(0xd134_2543_de82_ef95)), hand }
    }

    /// His slip in the next act.
    pub(super) fn slip(&mut self, kind: Pencil) -> f64 {
        self.roll() * self.hand.slip(kind)
    }

    /// Uniform in [−1, 1).
    fn roll(&mut self) -> f64 {
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit a double")]
        let part = (self.lots.draw() >> 11) as f64;
        part / 4_503_599_627_370_496.0 - 1.0
    }
}
