//! Numbers that look as if drawn by lot, the same on every machine: SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, 2014).

/// How far the counter goes from one number to the next.
const STRIDE: u64 = 0x9e37_79b9_7f4a_7c15;

/// Draws one number after the other.
#[derive(Debug, Clone)]
pub(crate) struct Lots(u64);

impl Lots {
    /// The row of numbers of this seed.
    pub(crate) fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    pub(crate) fn draw(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(STRIDE);
        scrambled(self.0)
    }
}

/// The number that belongs to a place in a row.
pub(crate) fn lot(place: u64) -> u64 {
    scrambled(place.wrapping_add(1).wrapping_mul(STRIDE))
}

/// The bits of a counter, mixed so that neighbours have nothing in common.
fn scrambled(mut bits: u64) -> u64 {
    bits = (bits ^ (bits >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    bits = (bits ^ (bits >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    bits ^ (bits >> 31)
}
