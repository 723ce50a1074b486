//! Which slots a sweep back has still to look at.

/// Bits of a word.
const WORD: usize = u64::BITS as usize;

/// Slots that wait to be looked at, the last first. A slot depends on earlier ones: what is added while the last is looked
/// at stands before it. What is given stands at the very beginning of a tape, and the way there must not cost a step for
/// each slot between: a bit stands for each slot, and a bit for each word of them in which any is set.
#[derive(Debug, Clone, Default)]
pub(super) struct Waiting {
    slots: Vec<u64>,
    words: Vec<u64>,
    /// No word of `words` beyond this one has a bit.
    last: usize,
}

impl Waiting {
    /// Adds a slot, if it does not wait already.
    #[inline]
    pub(super) fn add(&mut self, slot: u32) {
        let slot = slot as usize;
        let word = slot / WORD;
        if word >= self.slots.len() {
            self.slots.resize(word + 1, 0);
            self.words.resize(word / WORD + 1, 0);
        }
        self.slots[word] |= 1 << (slot % WORD);
        self.words[word / WORD] |= 1 << (word % WORD);
        self.last = self.last.max(word / WORD);
    }

    /// Takes out the last slot that waits.
    #[inline]
    pub(super) fn take_last(&mut self) -> Option<u32> {
        let word = loop {
            if let Some(bit) = self.words.get(self.last)?.checked_ilog2() {
                break self.last * WORD + bit as usize;
            }
            if self.last == 0 {
                return None;
            }
            self.last -= 1;
        };
        let bits = &mut self.slots[word];
        let bit = bits.checked_ilog2()?;
        *bits ^= 1 << bit;
        if *bits == 0 {
            self.words[self.last] ^= 1 << (word % WORD);
        }
        u32::try_from(word * WORD + bit as usize).ok()
    }
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use super::*;
    use crate::lots::Lots;

    /// As an ordered set gives them out.
    #[test]
    fn the_last_is_always_next() {
        for seed in 0..20 {
            let mut lots = Lots::new(seed);
            let (mut waiting, mut set) = (Waiting::default(), BTreeSet::new());
            for _ in 0..2000 {
                if !lots.draw().is_multiple_of(3) {
                    let slot = (lots.draw() % 1_000_000) as u32 >> (lots.draw() % 20);
                    waiting.add(slot);
                    set.insert(slot);
                } else {
                    assert_eq!(waiting.take_last(), set.pop_last());
                }
            }
            while let Some(slot) = set.pop_last() {
                assert_eq!(waiting.take_last(), Some(slot));
            }
            assert_eq!(waiting.take_last(), None);
        }
    }
}
