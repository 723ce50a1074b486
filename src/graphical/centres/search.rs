//! The search order of the circle diagram (`s000-ch3b` B): which two triangles lead to which chord.
//!
//! The search looks at the skeleton as one looks before one draws: rounded places, no strokes. What it finds is
//! drawn on the board afterwards, and only that.

use std::cell::Cell;
use std::collections::{BTreeMap, BTreeSet};
use std::rc::Rc;

use crate::mechanism::LinkId;
use crate::plan::chord;

/// The links of a centre, the lower first.
pub(super) type Chord = [LinkId; 2];

/// One line on which a sought centre lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CentreLine {
    /// Through the centres (i k) and (k j): one triangle of the circle diagram.
    Via(LinkId),
    /// The common normal of a sliding contact, by index of the sliding pair.
    Normal(usize),
}

/// Two lines that meet in the centre of a chord.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Derivation {
    pub(super) chord: Chord,
    pub(super) lines: [CentreLine; 2],
}

/// What is seen of the skeleton: homogeneous coordinates of order one.
#[derive(Debug, Default)]
pub(super) struct Atlas {
    /// The links between which centres may be used.
    pub(super) links: Vec<LinkId>,
    /// Centres that stand on the skeleton.
    pub(super) points: BTreeMap<Chord, [f64; 3]>,
    /// Common normals of sliding contacts.
    pub(super) normals: BTreeMap<Chord, (usize, [f64; 3])>,
    /// Derivations that have turned out to cross nowhere.
    pub(super) refused: BTreeSet<Derivation>,
    /// Looks that are left.
    pub(super) left: Cell<usize>,
}

/// How flat lines may cross, as sines: first as a draughtsman can read (about 3°, `drawing.md`), then as fine as
/// numbers still tell, then any.
const FLATTEST: [f64; 3] = [0.05, 1e-6, 0.0];

/// Of those the ones that tell where lines cross. Lines that differ by less are one line, but for rounding: a longer way is
/// better than a point of that.
const TELLING: &[f64] = FLATTEST.split_at(2).0;

/// Up to so many wanted centres the shortest way is sought among all; for more, nearly every chord is wanted.
const FEW: usize = 4;

/// Looks at so many partial ways at most, for each length.
const MOST_LOOKS: usize = 20_000;

/// And at so many for all goals, lengths and searches together: with many centres wanted of many links each search may be
/// long, and every line that turns out to be another one begins it anew. After that the centres are found in the order of
/// their numbers.
pub(super) const ALL_LOOKS: usize = 400_000;

/// Longest way that is sought among all.
const LONGEST: usize = 8;

impl Atlas {
    /// The derivations that lead to all wanted chords, in order of construction: as few as possible, and among
    /// as many the one whose flattest crossing is least flat. `None` where the diagram stalls.
    pub(super) fn order(&self, wanted: &[Chord]) -> Option<Vec<Derivation>> {
        let places = self.explored();
        let goals: Vec<Chord> = wanted.iter().copied().filter(|c| !self.points.contains_key(c)).collect();
        if goals.iter().any(|goal| !places.contains_key(goal)) {
            return None;
        }
        let all_at_once = if goals.len() <= FEW { self.shortest(&places, &goals) } else { None };
        Some(all_at_once.unwrap_or_else(|| self.one_by_one(&places, goals)))
    }

    /// Of these chords those to which derivations lead.
    pub(super) fn reached(&self, wanted: &[Chord]) -> BTreeSet<Chord> {
        let places = self.explored();
        wanted.iter().copied().filter(|chord| places.contains_key(chord)).collect()
    }

    /// Where all reachable centres lie, each found by the best crossing at the earliest possible time.
    fn explored(&self) -> BTreeMap<Chord, [f64; 3]> {
        let mut places = self.points.clone();
        while let Some((derivation, _)) = self.next(&places) {
            let Some(at) = self.meet(&places, derivation) else { break };
            places.insert(derivation.chord, at.0);
        }
        places
    }

    /// The next chord by number that can be derived from the known ones, flat crossings only where there is
    /// nothing better.
    fn next(&self, known: &BTreeMap<Chord, [f64; 3]>) -> Option<(Derivation, f64)> {
        FLATTEST.into_iter().find_map(|flattest| {
            self.chords().filter(|c| !known.contains_key(c)).find_map(|chord| {
                let all = self.derivations(known, chord);
                let best = all.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
                (best.1 > flattest).then_some(best)
            })
        })
    }

    fn chords(&self) -> impl Iterator<Item = Chord> + '_ {
        let after = |i: usize| self.links[i + 1..].iter().copied();
        self.links.iter().enumerate().flat_map(move |(i, &a)| after(i).map(move |b| [a, b]))
    }

    /// All derivations of a chord from these centres, with the sine of the flattest angle in each.
    fn derivations(&self, places: &BTreeMap<Chord, [f64; 3]>, chord: Chord) -> Vec<(Derivation, f64)> {
        let lines: Vec<CentreLine> = self
            .normals
            .get(&chord)
            .map(|(slide, _)| CentreLine::Normal(*slide))
            .into_iter()
            .chain(self.links.iter().filter(|k| !chord.contains(k)).map(|&k| CentreLine::Via(k)))
            .filter(|&line| self.line(places, chord, line).is_some())
            .collect();
        let mut all = Vec::new();
        for (i, &first) in lines.iter().enumerate() {
            for &second in &lines[i + 1..] {
                let derivation = Derivation { chord, lines: [first, second] };
                if !self.refused.contains(&derivation)
                    && let Some((_, sine)) = self.meet(places, derivation)
                {
                    all.push((derivation, sine));
                }
            }
        }
        all
    }

    /// A line of the extended plane, and the sine of the angle under which its two points are seen.
    fn line(
        &self,
        places: &BTreeMap<Chord, [f64; 3]>,
        [i, j]: Chord,
        line: CentreLine,
    ) -> Option<([f64; 3], f64)> {
        match line {
            CentreLine::Normal(_) => self.normals.get(&[i, j]).map(|(_, line)| (*line, 1.0)),
            CentreLine::Via(k) => {
                let (p, q) = (places.get(&chord(i, k))?, places.get(&chord(k, j))?);
                Some(cross(*p, *q))
            }
        }
    }

    fn meet(&self, places: &BTreeMap<Chord, [f64; 3]>, derivation: Derivation) -> Option<([f64; 3], f64)> {
        let [first, second] = derivation.lines.map(|line| self.line(places, derivation.chord, line));
        let ((first, seen), (second, seen_too)) = (first?, second?);
        let (point, crossing) = cross(first, second);
        Some((point, crossing.min(seen).min(seen_too)))
    }

    /// Goal by goal, the one that is nearest to what is known next.
    fn one_by_one(&self, places: &BTreeMap<Chord, [f64; 3]>, mut goals: Vec<Chord>) -> Vec<Derivation> {
        let mut known = self.points.clone();
        let mut all = Vec::new();
        while !goals.is_empty() {
            let near = |length: usize, flattest: &[f64]| {
                goals.iter().find_map(|goal| self.way(places, &known, &[*goal], (length, flattest)))
            };
            // Where no way is short enough to be sought, the next chord by number.
            let way = (1..=LONGEST)
                .find_map(|length| near(length, TELLING))
                .or_else(|| (1..=LONGEST).find_map(|length| near(length, &FLATTEST)))
                .or_else(|| self.next(&known).map(|(next, _)| vec![next]));
            let Some(way) = way else { break };
            for derivation in way {
                if let Some(at) = places.get(&derivation.chord) {
                    known.insert(derivation.chord, *at);
                }
                goals.retain(|goal| *goal != derivation.chord);
                all.push(derivation);
            }
        }
        all
    }

    /// The fewest derivations that lead to the goals.
    fn shortest(&self, places: &BTreeMap<Chord, [f64; 3]>, goals: &[Chord]) -> Option<Vec<Derivation>> {
        [TELLING, &FLATTEST].into_iter().find_map(|flattest| {
            (goals.len()..=LONGEST.max(goals.len()))
                .find_map(|length| self.way(places, &self.points, goals, (length, flattest)))
        })
    }

    /// A way of this length to the goals, as long as looks are left; with flat crossings only where there is none without.
    fn way(
        &self,
        places: &BTreeMap<Chord, [f64; 3]>,
        known: &BTreeMap<Chord, [f64; 3]>,
        goals: &[Chord],
        (length, flattest): (usize, &[f64]),
    ) -> Option<Vec<Derivation>> {
        flattest.iter().find_map(|&flattest| {
            let mut hunt = Hunt {
                atlas: self,
                places,
                known,
                flattest,
                length,
                chosen: Vec::new(),
                best: None,
                looks: MOST_LOOKS.min(self.left.get()),
                ways: BTreeMap::new(),
            };
            let before = hunt.looks;
            hunt.go(goals.to_vec(), 1.0);
            self.left.set(self.left.get() - (before - hunt.looks));
            hunt.best.map(|(_, best)| best)
        })
    }
}

/// A search for the ways of one length.
struct Hunt<'a> {
    atlas: &'a Atlas,
    places: &'a BTreeMap<Chord, [f64; 3]>,
    known: &'a BTreeMap<Chord, [f64; 3]>,
    flattest: f64,
    length: usize,
    chosen: Vec<Derivation>,
    best: Option<(f64, Vec<Derivation>)>,
    /// Looks that are left.
    looks: usize,
    ways: BTreeMap<Chord, Rc<[(Derivation, f64)]>>,
}

impl Hunt<'_> {
    fn go(&mut self, mut open: Vec<Chord>, flattest: f64) {
        if self.looks == 0 {
            return;
        }
        self.looks -= 1;
        if self.chosen.len() + open.len() > self.length {
            return;
        }
        let Some(goal) = open.pop() else {
            if let Some(order) = self.sorted()
                && self.best.as_ref().is_none_or(|(least_flat, _)| flattest > *least_flat)
            {
                self.best = Some((flattest, order));
            }
            return;
        };
        for &(derivation, sine) in self.derivations(goal).iter() {
            if self.looks == 0 {
                return;
            }
            let known = |c: &Chord| {
                self.atlas.points.contains_key(c)
                    || open.contains(c)
                    || self.chosen.iter().any(|d| d.chord == *c)
            };
            let mut next = open.clone();
            next.extend(sources(derivation).into_iter().filter(|c| !known(c)));
            self.chosen.push(derivation);
            self.go(next, flattest.min(sine));
            self.chosen.pop();
        }
    }

    /// The derivations of a chord from any centres, the best crossing first.
    fn derivations(&mut self, goal: Chord) -> Rc<[(Derivation, f64)]> {
        if let Some(ways) = self.ways.get(&goal) {
            return Rc::clone(ways);
        }
        let mut ways = self.atlas.derivations(self.places, goal);
        ways.retain(|(_, sine)| *sine > self.flattest);
        ways.sort_by(|a, b| b.1.total_cmp(&a.1).then(a.0.cmp(&b.0)));
        let ways: Rc<[(Derivation, f64)]> = ways.into();
        self.ways.insert(goal, Rc::clone(&ways));
        ways
    }

    /// The chosen derivations in an order in which each has what it needs; `None` where they go in a circle.
    fn sorted(&self) -> Option<Vec<Derivation>> {
        let mut known: BTreeSet<Chord> = self.known.keys().copied().collect();
        let mut rest = self.chosen.clone();
        let mut order = Vec::new();
        while !rest.is_empty() {
            let ready = |d: &Derivation| sources(*d).iter().all(|c| known.contains(c));
            let next = rest.iter().enumerate().filter(|(_, d)| ready(d)).min_by_key(|(_, d)| d.chord)?.0;
            let derivation = rest.remove(next);
            known.insert(derivation.chord);
            order.push(derivation);
        }
        Some(order)
    }
}

/// The centres by which a derivation's lines are drawn.
pub(super) fn sources(derivation: Derivation) -> Vec<Chord> {
    let [i, j] = derivation.chord;
    let ends = |line: CentreLine| match line {
        CentreLine::Via(k) => vec![chord(i, k), chord(k, j)],
        CentreLine::Normal(_) => Vec::new(),
    };
    derivation.lines.into_iter().flat_map(ends).collect()
}

/// The cross product of two vectors of order one, brought to order one, and the sine of the angle between them.
fn cross(a: [f64; 3], b: [f64; 3]) -> ([f64; 3], f64) {
    let product = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    let length = |v: [f64; 3]| libm::sqrt(v.iter().map(|x| x * x).sum());
    let (size, sizes) = (length(product), length(a) * length(b));
    if size > 0.0 && sizes > 0.0 { (product.map(|x| x / size), size / sizes) } else { (product, 0.0) }
}
