//! A link on three legs, the group of higher class that has a construction of its own: moments of each leg about its
//! outer pin give the part of its force across it; then the lines of two legs meet, and moments of the middle link about
//! their meet give the force along the third; the polygon of the middle link gives the other two.

use crate::board::{Amount, Direction, Line, Point};
use crate::mechanism::force::Action;
use crate::mechanism::structure::{Group, Joint};
use crate::mechanism::{LinkId, PointId, Rider};

use super::super::draughtsman::Draughtsman;
use super::groups::Sliding;
use super::{About, Balance, Item, Pull, SlideForce, Taken, TakenFor, pulls};

/// Two lines that cross at less than this sine are parallel: they have no meet on paper.
const PARALLEL: f64 = 1e-3;

/// What holds the middle link at one of three places.
#[derive(Debug, Clone, Copy)]
enum Leg {
    /// A link with a pin on a solved one.
    Bar { link: LinkId, base: PointId, pin: PointId },
    /// A pin of the middle link rides on a solved link, itself or in a block.
    Rides { slide: usize, pin: PointId },
    /// A solved pin rides on the middle link.
    Carries { slide: usize, pin: PointId },
    /// The middle link rolls on a solved one, at a distance that others hold.
    Rolls { roll: usize },
}

/// A link on three legs.
#[derive(Debug, Clone)]
pub(super) struct Triad {
    middle: LinkId,
    legs: [Leg; 3],
}

/// What is known of a leg before the middle link is balanced.
struct Known {
    /// The line of what is left: through this place of the middle link, in this direction.
    line: Line,
    /// What it exerts on the middle link besides.
    on_middle: Vec<Item>,
    /// Of a bar the part across it, on the bar.
    across: Option<Pull>,
}

impl Draughtsman<'_> {
    /// The legs of a group of higher class, where it is a link on three legs and nothing else.
    pub(super) fn triad(&self, group: &Group) -> Option<Triad> {
        let m = self.mechanism;
        let rods: Vec<LinkId> = group.links.iter().copied().filter(|link| !m.link(*link).block).collect();
        let inside = |point: &PointId| group.points.contains(point);
        let only_two = |pin: PointId| m.parties_at(pin).len() == 2;
        let pins = |link: LinkId| -> Vec<PointId> {
            let own = group.joints.iter().filter_map(|joint| match *joint {
                Joint::Pin(of, point) if of == link => Some(point),
                _ => None,
            });
            own.collect()
        };
        'middle: for &middle in &rods {
            let mut legs = Vec::new();
            for &link in rods.iter().filter(|link| **link != middle) {
                let (outer, inner): (Vec<PointId>, Vec<PointId>) =
                    pins(link).into_iter().partition(|pin| !inside(pin));
                match (&outer[..], &inner[..]) {
                    (&[base], &[pin]) if m.point(pin).links.contains(&middle) && only_two(pin) => {
                        legs.push(Leg::Bar { link, base, pin });
                    }
                    _ => continue 'middle,
                }
            }
            for joint in &group.joints {
                match *joint {
                    Joint::Slide(slide) => {
                        let Rider::Pin { point, block } = m.slides[slide].rider else { continue 'middle };
                        let guide = m.slides[slide].guide.link;
                        let alone = m.point(point).links.iter().all(|l| *l == middle || Some(*l) == block);
                        if guide == middle && !inside(&point) {
                            legs.push(Leg::Carries { slide, pin: point });
                        } else if !group.links.contains(&guide)
                            && m.point(point).links.contains(&middle)
                            && alone
                        {
                            legs.push(Leg::Rides { slide, pin: point });
                        } else {
                            continue 'middle;
                        }
                    }
                    Joint::Roll(roll) => {
                        let bodies = m.rolls[roll].bodies();
                        let inner = bodies.iter().filter(|body| group.links.contains(body)).count();
                        if inner != 1 || !bodies.contains(&middle) || self.keeps_contact(roll) {
                            continue 'middle;
                        }
                        legs.push(Leg::Rolls { roll });
                    }
                    Joint::Pin(..) => {}
                    _ => continue 'middle,
                }
            }
            // A pin of the middle link on a solved one would make it a leg itself.
            let free = pins(middle).iter().all(inside);
            if let (true, Ok(legs)) = (free, <[Leg; 3]>::try_from(legs)) {
                return Some(Triad { middle, legs });
            }
        }
        None
    }

    /// Moments of a leg about its outer pin, or what rides with it.
    fn leg(&mut self, middle: LinkId, leg: Leg, balance: &mut Balance) -> Known {
        match leg {
            Leg::Bar { link, base, pin } => {
                let items = balance.on(link);
                let at_base = self.touch_at(balance, base, link);
                let at = self.inner_touch(balance, pin, [middle, link]);
                let reason = self.reason(&[link]);
                let (along, _) = self.board.toward(at_base, at, reason);
                let across = self.moments(&items, at_base).map(|moments| {
                    let across = self.board.quarter_turn(along);
                    let line = Line { through: at, along: across };
                    let size = self.balancing(Some(moments), line, at_base, &[link]);
                    let found = TakenFor::Across { pin, by: middle, on: link, from: base };
                    balance.taken.push(Taken { links: vec![link], about: About::Point(base), found });
                    self.pull_along(across, size)
                });
                let back = across.map(Self::opposite);
                let on_middle = back.map(|pull| Item { pull: Some(pull), at, couple: None });
                let line = Line { through: at, along };
                Known { line, on_middle: on_middle.into_iter().collect(), across }
            }
            Leg::Rides { slide, pin } => {
                let sliding = self.sliding(slide, None);
                let at = self.at(pin);
                let touch = match sliding.inner {
                    Some(block) => self.inner_touch(balance, pin, [middle, block]),
                    None => at,
                };
                let (_, along) = self.pressing_at(balance, slide, at);
                let on_block = balance.on_some(sliding.inner);
                let handed = pulls(&on_block).into_iter();
                let on_middle =
                    handed.map(|pull| Item { pull: Some(pull), at: touch, couple: None }).collect();
                Known { line: Line { through: touch, along }, on_middle, across: None }
            }
            Leg::Carries { slide, pin } => {
                let sliding = self.sliding(slide, None);
                let at = self.at(pin);
                let (_, along) = self.pressing_at(balance, slide, at);
                // What would turn the block is kept by the middle link, which feels it.
                let on_block = balance.on_some(sliding.inner);
                let couple = self.moments(&on_block, at);
                let on_middle = couple.map(|couple| Item { pull: None, at, couple: Some(couple) });
                let on_middle = on_middle.into_iter().collect();
                Known { line: Line { through: at, along }, on_middle, across: None }
            }
            Leg::Rolls { roll } => {
                let contact = self.contact_at(roll);
                let line = Line { through: contact.at, along: contact.tangent };
                Known { line, on_middle: Vec::new(), across: None }
            }
        }
    }

    /// What a rolling leg exerts on the middle link, with what teeth push apart; none of other legs.
    fn leaning_leg_of(&mut self, balance: &Balance, middle: LinkId, leg: Leg, along: Pull) -> Option<Pull> {
        let Leg::Rolls { roll } = leg else { return None };
        let contact = self.contact_at(roll);
        let parts = self.components_of(along);
        let size = self.part_along(parts, contact.tangent);
        Some(self.rolling_pull(balance, (roll, middle), &contact, size))
    }

    /// Notes what a leg exerts on the middle link along its line, and balances the leg.
    fn settle_leg(&mut self, middle: LinkId, leg: Leg, known: &Known, along: Pull, balance: &mut Balance) {
        match leg {
            Leg::Bar { link, base, pin } => {
                let mut parts = vec![Self::opposite(along)];
                parts.extend(known.across);
                let head = self.chained(&parts);
                let on_leg = Pull { tail: self.board.origin(), head };
                let of_leg = [(link, on_leg), (middle, Self::opposite(on_leg))];
                self.note_inner_pin(balance, pin, of_leg);
                let mut all = pulls(&balance.on(link));
                all.push(on_leg);
                let reaction = self.closing(&all);
                self.note_pin(balance, base, link, reaction);
            }
            Leg::Rides { slide, pin } => {
                let sliding = self.sliding(slide, None);
                let at = self.at(pin);
                let items = balance.on_some(sliding.inner);
                let mut all = pulls(&items);
                all.push(along);
                let of_pin = self.closing(&all);
                let mut about = items;
                if let (true, Some(block)) = (Self::rubs_at(balance, pin), sliding.inner) {
                    let touch = self.inner_touch(balance, pin, [middle, block]);
                    about.push(Item { pull: Some(of_pin), at: touch, couple: None });
                }
                let couple = if sliding.inner.is_some() { self.keeping(&about, at) } else { None };
                self.note_slide(balance, slide, &sliding, pin, SlideForce { pull: along, at, couple });
                if let Some(block) = sliding.inner {
                    let at_pin = [(middle, Self::opposite(of_pin)), (block, of_pin)];
                    self.note_inner_pin(balance, pin, at_pin);
                }
            }
            Leg::Carries { slide, pin } => {
                let sliding: Sliding = self.sliding(slide, None);
                let at = self.at(pin);
                let on_inner = Self::opposite(along);
                let items = balance.on_some(sliding.inner);
                let couple = self.keeping(&items, at);
                self.note_slide(balance, slide, &sliding, pin, SlideForce { pull: on_inner, at, couple });
                match sliding.inner {
                    Some(block) => {
                        let mut all = pulls(&items);
                        all.push(on_inner);
                        let of_pin = self.closing(&all);
                        self.note_pin(balance, pin, block, of_pin);
                    }
                    None => {
                        let item = Item { pull: Some(on_inner), at, couple: None };
                        balance.push_on_pin(self, pin, item);
                    }
                }
            }
            Leg::Rolls { roll } => {
                let contact = self.contact_at(roll);
                self.rolls_on(balance, roll, (middle, along), contact.at);
            }
        }
    }

    /// The force with which a leg acts on the middle link, as it is told.
    fn force_of_leg(&self, middle: LinkId, leg: Leg) -> Action {
        match leg {
            Leg::Bar { link, .. } => Action::Pair { by: link, on: middle },
            Leg::Rides { slide, .. } => match self.sliding(slide, None).inner {
                Some(block) => Action::Pair { by: self.mechanism.slides[slide].guide.link, on: block },
                None => Action::Pair { by: self.mechanism.slides[slide].guide.link, on: middle },
            },
            Leg::Carries { slide, pin } => match self.sliding(slide, None).inner {
                Some(block) => Action::Pair { by: block, on: middle },
                None => Action::OfPin(pin, middle),
            },
            Leg::Rolls { roll } => self.mechanism.force_of_roll(roll, middle),
        }
    }
}

/// The forces along three lines that hold a link.
struct Solved {
    /// The two lines that meet, and the third.
    pair: [usize; 2],
    third: usize,
    meet: Point,
    on_middle: [Pull; 3],
}

/// Moments about the meet of the two lines that cross best give the third force, the polygon the other two; none where
/// all lines are parallel.
fn across_the_meet(
    d: &mut Draughtsman<'_>,
    middle: LinkId,
    items: &[Item],
    lines: [Line; 3],
) -> Option<Solved> {
    let crossing = |[i, j]: [usize; 2]| sine(lines[i].along, lines[j].along).abs();
    let pairs = [[0, 1], [1, 2], [0, 2]];
    let best = pairs
        .into_iter()
        .fold([0, 1], |best, pair| if crossing(pair) > crossing(best) { pair } else { best });
    if crossing(best) < PARALLEL {
        return None;
    }
    let [i, j] = best;
    let third = 3 - i - j;
    let reason = d.reason(&[middle]);
    let meet = d.board.meet_lines(lines[i], lines[j], reason).at;
    let moments = d.moments(items, meet);
    let size: Amount = d.balancing(moments, lines[third], meet, &[middle]);
    let along = d.pull_along(lines[third].along, size);
    let mut all = pulls(items);
    all.push(along);
    let [first, second] = d.two_lines(&all, [lines[i].along, lines[j].along], &[middle]);
    let mut on_middle = [along; 3];
    (on_middle[i], on_middle[j]) = (first, second);
    Some(Solved { pair: best, third, meet, on_middle })
}

/// The sine of the angle between two directions, as it is seen.
fn sine(a: Direction, b: Direction) -> f64 {
    let ([ax, ay], [bx, by]) = (a.value(), b.value());
    ax * by - ay * bx
}

/// The balance of a group that is a link on three legs; `false`, and nothing noted, where it is none or where the lines of
/// the legs are all parallel.
pub(super) fn on_legs(d: &mut Draughtsman<'_>, group: &Group, balance: &mut Balance) -> bool {
    let Some(legs) = d.triad(group) else { return false };
    let before = balance.clone();
    let found = triad(d, &legs, balance);
    if !found {
        *balance = before;
    }
    found
}

fn triad(d: &mut Draughtsman<'_>, triad: &Triad, balance: &mut Balance) -> bool {
    let Triad { middle, legs } = triad.clone();
    // A circle at a solved pin in a slot of the middle link hands on a couple that hangs on the force.
    let rubs = |leg: &Leg| matches!(leg, Leg::Carries { pin, .. } if Draughtsman::rubs_at(balance, *pin));
    if legs.iter().any(rubs) {
        return false;
    }
    let known = legs.map(|leg| d.leg(middle, leg, balance));
    let mut items = balance.on(middle);
    items.extend(known.iter().flat_map(|known| known.on_middle.iter().copied()));
    let mut lines = [0, 1, 2].map(|k: usize| known[k].line);
    let Some(mut solved) = across_the_meet(d, middle, &items, lines) else { return false };
    let toothed = |leg: &Leg| matches!(leg, Leg::Rolls { roll } if d.leans_by_teeth(*roll));
    let inclined = super::friction::rubs(d) && !items.is_empty() && legs.iter().any(toothed);
    if inclined {
        // What pushes apart passes by the points where pins touch their circles.
        for (k, leg) in legs.into_iter().enumerate() {
            if let Leg::Rolls { roll } = leg {
                let contact = d.contact_at(roll);
                let parts = d.components_of(solved.on_middle[k]);
                let size = d.part_along(parts, contact.tangent);
                lines[k] = d.line_of_teeth(balance, (roll, middle), &contact, size).unwrap_or(lines[k]);
            }
        }
        let Some(again) = across_the_meet(d, middle, &items, lines) else { return false };
        solved = again;
    }
    let Solved { pair: [i, j], third, meet, mut on_middle } = solved;
    let found = match legs[third] {
        Leg::Bar { link, base, pin } => {
            let whole = known[third].across.is_none();
            TakenFor::Along { pin, by: link, on: middle, from: base, whole }
        }
        Leg::Rides { slide, .. } => TakenFor::Slide(slide),
        Leg::Carries { slide, .. } => TakenFor::Slot(slide),
        Leg::Rolls { roll } => TakenFor::Roll { roll, on: middle, presses: false },
    };
    let blocks = legs.iter().filter_map(|leg| match leg {
        Leg::Rides { slide, .. } => d.sliding(*slide, None).inner,
        _ => None,
    });
    let links: Vec<LinkId> = std::iter::once(middle).chain(blocks).collect();
    let of = [i, j].map(|leg| d.force_of_leg(middle, legs[leg]));
    let bars = legs.iter().zip(&known).filter_map(|(leg, known)| match *leg {
        Leg::Bar { link, base, pin } => Some((pin, link, base, known.across.is_some())),
        _ => None,
    });
    let bars = bars.collect();
    balance.taken.push(Taken { links, about: About::Meet { of, at: meet, bars }, found });
    // What teeth push apart the others hold, at whose distance it does no work: the sizes along the tangents stand.
    let leaning = [0, 1, 2]
        .map(|k| if inclined { None } else { d.leaning_leg_of(balance, middle, legs[k], on_middle[k]) });
    let others: Vec<usize> = (0..3).filter(|k| leaning[*k].is_none()).collect();
    if others.len() < 3 {
        let mut all = pulls(&items);
        all.extend(leaning.iter().flatten());
        match others[..] {
            [one] => on_middle[one] = d.closing(&all),
            [one, other] => {
                let lines = [one, other].map(|k| known[k].line.along);
                [on_middle[one], on_middle[other]] = d.two_lines(&all, lines, &[middle]);
            }
            _ => return false,
        }
        for (k, pull) in leaning.into_iter().enumerate() {
            on_middle[k] = pull.unwrap_or(on_middle[k]);
        }
    }
    for (index, leg) in legs.into_iter().enumerate() {
        d.settle_leg(middle, leg, &known[index], on_middle[index], balance);
    }
    true
}
