//! Which numbers each try takes: from the seed and the number of the try alone, so that neither the order
//! of work nor the number of workers changes a variant.

use crate::lots::Lots;
use crate::scene::Varied;

/// Up to so many different scenes all are tried, each once.
const FEW: u64 = 1 << 20;

/// A number from 0 to below `end`.
fn below(lots: &mut Lots, end: u64) -> u64 {
    ((u128::from(lots.draw()) * u128::from(end)) >> 64) as u64
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
            let mut lots = Lots::new(seed);
            // Fisher and Yates.
            for end in (1..order.len()).rev() {
                order.swap(end, below(&mut lots, end as u64 + 1) as usize);
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
        let mut lots = Lots::new(self.seed ^ number.wrapping_mul(0xd134_2543_de82_ef95));
        Some(self.counts.iter().map(|count| below(&mut lots, *count)).collect())
    }
}
