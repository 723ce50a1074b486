//! The draughtsman's own hand: pencil, ruler and set square instead of an arithmetic.
//!
//! Every length that is laid off, every direction that is drawn and every reading slips by up to the hand's
//! error. What that does to an answer is found in two ways: as a bound, by one sweep back over the tape with
//! the slips in the place of the roundings; and as a distribution, by many draughtsmen with dice.

use super::tape::{Operation, Pencil, Reason, Reckoning, Recorder, Tape};

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
    fn slip(self, kind: Pencil) -> f64 {
        match kind {
            Pencil::Length | Pencil::Reading => self.length,
            Pencil::Direction | Pencil::AngleReading => self.angle,
        }
    }
}

/// Records a perfect drawing and what every slip would do to it; roundings count for nothing.
#[derive(Debug, Clone)]
pub struct PencilTape {
    tape: Tape,
    hand: Hand,
}

impl PencilTape {
    /// A clean tape for this hand.
    #[must_use]
    pub fn new(hand: Hand) -> Self {
        Self { tape: Tape::default(), hand }
    }

    /// What all slips together can do to a result, to first order.
    pub fn worst(&mut self, mark: u32) -> f64 {
        self.tape.total_error(mark)
    }

    /// Whether every divisor and half chord behind a result stands clear of its own slips; where one does
    /// not, first order says little.
    pub fn is_clear(&mut self, mark: u32) -> bool {
        self.tape.weakness(mark).is_none()
    }
}

impl Recorder for PencilTape {
    type Mark = u32;

    fn given(&mut self, _: f64, _: f64) -> u32 {
        self.tape.push(&[], 0.0)
    }

    fn result(&mut self, _: Reckoning, parts: &[(u32, f64)], _: f64) -> u32 {
        self.tape.push(parts, 0.0)
    }

    fn pencil(&mut self, kind: Pencil) -> Option<(f64, u32)> {
        Some((0.0, self.tape.push(&[], self.hand.slip(kind))))
    }

    fn divisor(&mut self, mark: u32, value: f64, reason: Reason) {
        self.tape.divisor(mark, value, reason);
    }

    fn error(&mut self, mark: u32) -> Option<f64> {
        self.tape.error(mark)
    }

    fn stroke(&mut self, _: Operation, _: [f64; 2], _: [u32; 2], _: &'static str) -> [f64; 2] {
        [0.0; 2]
    }
}

/// A draughtsman with dice: each slip is uniform between its limits. The same seed draws the same drawing
/// on every machine (SplitMix64; G. L. Steele, D. Lea, C. H. Flood, 2014).
#[derive(Debug, Clone)]
pub struct Tremor {
    state: u64,
    hand: Hand,
}

impl Tremor {
    /// The draughtsman of this number.
    #[must_use]
    pub fn new(hand: Hand, seed: u64) -> Self {
        Self { state: seed.wrapping_mul(0xd134_2543_de82_ef95), hand }
    }

    /// Uniform in [−1, 1).
    fn roll(&mut self) -> f64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        #[expect(clippy::cast_precision_loss, reason = "53 bits fit a double")]
        let part = (z >> 11) as f64;
        part / 4_503_599_627_370_496.0 - 1.0
    }
}

impl Recorder for Tremor {
    type Mark = ();

    fn given(&mut self, _: f64, _: f64) {}

    fn result(&mut self, _: Reckoning, _: &[((), f64)], _: f64) {}

    fn pencil(&mut self, kind: Pencil) -> Option<(f64, ())> {
        Some((self.roll() * self.hand.slip(kind), ()))
    }

    fn divisor(&mut self, (): (), _: f64, _: Reason) {}

    fn error(&mut self, (): ()) -> Option<f64> {
        None
    }

    fn stroke(&mut self, _: Operation, _: [f64; 2], _: [(); 2], _: &'static str) -> [f64; 2] {
        [0.0; 2]
    }
}
