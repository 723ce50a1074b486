//! Which numbers each try takes: from the seed and the number of the try alone, so that neither the order
//! of work nor the number of workers changes a variant.

use crate::scene::Varied;

/// Up to so many different scenes all are tried, each once.
const FEW: u64 = 1 << 20;

/// SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, 2014).
#[derive(Debug, Clone)]
struct Dice(u64);

impl Dice {
    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// From 0 to below `end`.
    fn below(&mut self, end: u64) -> u64 {
        ((u128::from(self.next()) * u128::from(end)) >> 64) as u64
    }
}

/// The tries of an exam, in their order.
#[derive(Debug, Clone)]
pub(super) struct Tries {
    seed: u64,
    counts: Vec<u64>,
    /// All scenes in the order in which they are tried, where they are few.
    shuffled: Option<Vec<u32>>,
}

impl Tries {
    pub(super) fn new(vary: &[Varied], seed: u64) -> Self {
        let counts: Vec<u64> = vary.iter().map(|v| v.range.count()).collect();
        let all = counts.iter().try_fold(1_u64, |product, count| product.checked_mul(*count));
        let shuffled = all.filter(|all| *all <= FEW).map(|all| {
            let mut order: Vec<u32> = (0..all as u32).collect();
            let mut dice = Dice(seed);
            // Fisher and Yates.
            for end in (1..order.len()).rev() {
                order.swap(end, dice.below(end as u64 + 1) as usize);
            }
            order
        });
        Self { seed, counts, shuffled }
    }

    /// How many different scenes the ranges give, where they can all be tried.
    pub(super) fn all(&self) -> Option<u64> {
        self.shuffled.as_ref().map(|order| order.len() as u64)
    }

    /// Which number of each range a try takes; `None` beyond the last one.
    pub(super) fn indices(&self, number: u64) -> Option<Vec<u64>> {
        if let Some(order) = &self.shuffled {
            let mut rest = u64::from(*order.get(usize::try_from(number).ok()?)?);
            let take = |count: &u64| {
                let index = rest % count;
                rest /= count;
                index
            };
            return Some(self.counts.iter().map(take).collect());
        }
        let mut dice = Dice(self.seed ^ number.wrapping_mul(0xd134_2543_de82_ef95));
        Some(self.counts.iter().map(|count| dice.below(*count)).collect())
    }
}
