//! Which of several things belongs to which of several places: one to one, at the least cost in all.

use std::cmp::Reverse;
use std::collections::{BinaryHeap, HashMap};

/// Gives each of some claimants one of the places that it may have, no place to two of them, so that as many as
/// possible have one and the costs in all are least. `costs` lists of each claimant its places with what they cost
/// (finite). `None` for whoever goes without.
///
/// One claimant after the other, by the cheapest chain of which each gives its place to the one before and takes another
/// (Jonker and Volgenant, on what is listed alone): about as many looks as there are claimants times what is listed.
pub(super) fn assign(costs: &[Vec<(usize, f64)>]) -> Vec<Option<usize>> {
    // The places by numbers of their own; behind them one nowhere for each claimant, dearer than all others together.
    let mut numbers: HashMap<usize, usize> = HashMap::new();
    let mut places: Vec<usize> = Vec::new();
    let mut dearest = 0.0_f64;
    for &(at, cost) in costs.iter().flatten() {
        dearest = dearest.max(cost.abs());
        numbers.entry(at).or_insert_with(|| {
            places.push(at);
            places.len() - 1
        });
    }
    let nowhere = 2.0 * (dearest + 1.0) * (costs.len() as f64 + 1.0);
    let known = places.len();
    let rows: Vec<Vec<(usize, f64)>> = costs
        .iter()
        .enumerate()
        .map(|(index, own)| {
            let listed = own.iter().map(|(at, cost)| (numbers[at], *cost));
            listed.chain([(known + index, nowhere)]).collect()
        })
        .collect();
    let mut game = Game {
        rows,
        owner: vec![None; known + costs.len()],
        place: vec![None; costs.len()],
        of_row: vec![0.0; costs.len()],
        of_place: vec![0.0; known + costs.len()],
    };
    for claimant in 0..costs.len() {
        game.seat(claimant);
    }
    game.place.into_iter().map(|place| place.and_then(|number| places.get(number).copied())).collect()
}

/// Who has what so far, and the prices by which no claimant would rather have another place.
struct Game {
    rows: Vec<Vec<(usize, f64)>>,
    owner: Vec<Option<usize>>,
    place: Vec<Option<usize>>,
    of_row: Vec<f64>,
    of_place: Vec<f64>,
}

impl Game {
    fn seat(&mut self, first: usize) {
        let mut shortest: HashMap<usize, (f64, usize)> = HashMap::new();
        // Places that are reached at their least cost, in that order.
        let mut reached: Vec<(usize, f64)> = Vec::new();
        let mut done: Vec<bool> = vec![false; self.owner.len()];
        // Costs are not negative: their bits are in order.
        let mut open: BinaryHeap<Reverse<(u64, usize)>> = BinaryHeap::new();
        let (mut row, mut spent) = (first, 0.0_f64);
        let last = loop {
            for &(place, cost) in &self.rows[row] {
                let more = (cost - self.of_row[row] - self.of_place[place]).max(0.0);
                let cost = spent + more;
                if !done[place] && shortest.get(&place).is_none_or(|(known, _)| cost < *known) {
                    shortest.insert(place, (cost, row));
                    open.push(Reverse((cost.to_bits(), place)));
                }
            }
            let Some(Reverse((bits, place))) = open.pop() else { return };
            if done[place] {
                continue;
            }
            spent = f64::from_bits(bits);
            done[place] = true;
            reached.push((place, spent));
            match self.owner[place] {
                None => break place,
                Some(owner) => row = owner,
            }
        };
        self.of_row[first] += spent;
        for (place, cost) in reached {
            if let Some(owner) = self.owner[place] {
                self.of_row[owner] += spent - cost;
                self.of_place[place] -= spent - cost;
            }
        }
        let mut place = last;
        loop {
            let Some(&(_, row)) = shortest.get(&place) else { return };
            self.owner[place] = Some(row);
            let left = self.place[row].replace(place);
            match left {
                Some(left) if row != first => place = left,
                _ => return,
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every way to give `n` claimants different places, tried.
    fn least(costs: &[Vec<(usize, f64)>], taken: &mut Vec<usize>) -> (usize, f64) {
        let Some((own, rest)) = costs.split_first() else { return (0, 0.0) };
        let mut best = least(rest, taken);
        for &(at, cost) in own {
            if taken.contains(&at) {
                continue;
            }
            taken.push(at);
            let (count, sum) = least(rest, taken);
            taken.pop();
            if count + 1 > best.0 || (count + 1 == best.0 && sum + cost < best.1) {
                best = (count + 1, sum + cost);
            }
        }
        best
    }

    /// A long row in which everybody stands nearer to the neighbour's place: whoever comes last moves all others.
    #[test]
    fn a_thousand_that_all_have_to_move_are_soon_seated() {
        let row = |n: usize| -> Vec<Vec<(usize, f64)>> {
            let near =
                |i: usize| (i.saturating_sub(6)..(i + 6).min(n)).map(move |at| (at, far(i, at))).collect();
            (0..n).rev().map(near).collect()
        };
        fn far(i: usize, at: usize) -> f64 {
            ((i as f64) - 0.8 - (at as f64)).abs()
        }
        assert!(assign(&row(2_000)).iter().all(Option::is_some));
    }

    #[test]
    fn whoever_can_have_it_cheapest_has_it() {
        assert_eq!(assign(&[vec![(7, 1.0)], vec![(7, 0.0)]]), [None, Some(7)]);
    }

    #[test]
    fn it_is_what_trying_all_finds() {
        let mut seed = 7_u32;
        let mut next = || {
            seed = seed.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            seed >> 16
        };
        for _ in 0..300 {
            let costs: Vec<Vec<(usize, f64)>> = (0..1 + next() % 5)
                .map(|_| {
                    let mut own: Vec<(usize, f64)> = Vec::new();
                    for at in 0..5 {
                        if next() % 3 > 0 {
                            own.push((at, f64::from(next() % 100)));
                        }
                    }
                    own
                })
                .collect();
            let given = assign(&costs);
            let mut places: Vec<usize> = given.iter().flatten().copied().collect();
            let count = places.len();
            places.sort_unstable();
            places.dedup();
            assert_eq!(places.len(), count, "a place is given twice");
            let cost = |(own, at): (&Vec<(usize, f64)>, &Option<usize>)| {
                at.and_then(|at| own.iter().find(|(known, _)| *known == at)).map_or(0.0, |(_, cost)| *cost)
            };
            let sum: f64 = costs.iter().zip(&given).map(cost).sum();
            let (most, cheapest) = least(&costs, &mut Vec::new());
            assert_eq!(count, most, "{costs:?} {given:?}");
            assert!((sum - cheapest).abs() < 1e-9, "{costs:?} {given:?}: {sum}, {cheapest}");
        }
    }
}
