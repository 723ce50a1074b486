//! Which of several things belongs to which of several places: one to one, at the least cost in all.

use std::collections::{HashMap, VecDeque};

/// Gives each of some claimants one of the places that it may have, no place to two of them, so that as many as
/// possible have one and the costs in all are least. `costs` lists of each claimant its places with what they cost
/// (finite). `None` for whoever goes without.
pub(super) fn assign(costs: &[Vec<(usize, f64)>]) -> Vec<Option<usize>> {
    let mut place: Vec<Option<usize>> = vec![None; costs.len()];
    let mut owner: HashMap<usize, usize> = HashMap::new();
    for first in 0..costs.len() {
        // The cheapest chain of claimants, each of which gives its place to the one before and takes another.
        let mut least: HashMap<usize, f64> = HashMap::from([(first, 0.0)]);
        let mut came: HashMap<usize, (usize, usize)> = HashMap::new();
        let mut free: Option<(f64, usize, usize)> = None;
        let mut open = VecDeque::from([first]);
        while let Some(one) = open.pop_front() {
            for &(at, cost) in &costs[one] {
                if place[one] == Some(at) {
                    continue;
                }
                let spent = least[&one] + cost;
                match owner.get(&at) {
                    None if free.is_none_or(|(best, ..)| spent < best) => free = Some((spent, one, at)),
                    None => {}
                    Some(&other) => {
                        let back = costs[other].iter().find(|(known, _)| *known == at);
                        let spent = spent - back.map_or(0.0, |(_, cost)| *cost);
                        if least.get(&other).is_none_or(|known| spent < known - LITTLE) && other != first {
                            least.insert(other, spent);
                            came.insert(other, (one, at));
                            open.push_back(other);
                        }
                    }
                }
            }
        }
        let Some((_, mut one, mut at)) = free else { continue };
        loop {
            place[one] = Some(at);
            owner.insert(at, one);
            let Some(&(before, left)) = came.get(&one).filter(|_| one != first) else { break };
            (one, at) = (before, left);
        }
    }
    place
}

/// Sums of costs that differ by less are one.
const LITTLE: f64 = 1e-9;

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
