//! The order in which the bodies of a group are told: each when what its polygon takes as known was found before, by
//! moments, by the polygon of another body, or because it is given.

use crate::mechanism::force::Action;
use crate::mechanism::{LinkId, Mechanism, PointId};

use super::super::construction::{Acting, FreeBody, Knowledge, MomentBalance, Turning};
use super::moments::same_pair;

/// What of a force is found.
#[derive(Debug, Clone, Copy)]
enum Part {
    Whole(Action),
    /// Along the line of a link, or across it.
    Along(Action),
    Across(Action),
}

/// What is found so far.
#[derive(Debug, Clone)]
pub(super) struct Told<'m> {
    mechanism: &'m Mechanism,
    found: Vec<Part>,
    shown: Vec<LinkId>,
}

/// The bodies of a group, and the moments of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Group<'a> {
    /// One for each body, in the order that is preferred.
    pub(super) bodies: &'a [FreeBody],
    pub(super) moments: &'a [MomentBalance],
    /// Links that have two forces together.
    pub(super) members: &'a [&'a [LinkId]],
}

impl<'m> Told<'m> {
    pub(super) fn new(mechanism: &'m Mechanism, known: &[Action]) -> Self {
        Self { mechanism, found: known.iter().copied().map(Part::Whole).collect(), shown: Vec::new() }
    }

    /// Takes up a force.
    pub(super) fn learn_force(&mut self, action: Action) {
        self.found.push(Part::Whole(action));
    }

    /// Takes up the part of a force along the line of its link.
    pub(super) fn learn_along(&mut self, action: Action) {
        self.found.push(Part::Along(action));
    }

    fn whole(&self, action: Action) -> bool {
        let has = |is: fn(&Part) -> Option<Action>| {
            self.found.iter().filter_map(is).any(|found| same_pair(found, action))
        };
        let parts = [across as fn(&Part) -> Option<Action>, along];
        has(whole) || parts.into_iter().all(has)
    }

    fn knows(&self, action: Action) -> bool {
        let given = match action {
            Action::Load(index) => !self.mechanism.forces.loads[index].is_sought(),
            Action::Spring { index, .. } => !self.mechanism.forces.springs[index].is_sought(),
            Action::Weight(_) | Action::Inertia(_) | Action::Centrifugal(_) | Action::Drag(_) => true,
            _ => false,
        };
        // A pin hands on to one link what all others exert on it.
        let handed_on = |pin, on| {
            let others = self.mechanism.parties_at(pin).into_iter().filter(|link| *link != on);
            others.into_iter().all(|link| self.whole(Action::OfPin(pin, link)))
        };
        given
            || self.whole(action)
            || match action {
                Action::OfPin(pin, link) | Action::OnPin(link, pin) => {
                    self.mechanism.drive_of_pin(pin).is_none() && handed_on(pin, link)
                }
                _ => false,
            }
    }

    /// How many sizes of a force are not found.
    fn open(&self, acting: &Acting) -> usize {
        let part =
            |found: &Part| across(found).or(along(found)).is_some_and(|of| same_pair(of, acting.action));
        match acting.known {
            _ if self.knows(acting.action) => 0,
            _ if self.found.iter().any(part) => 1,
            Knowledge::Nothing => 2,
            Knowledge::Line | Knowledge::Full => 1,
        }
    }

    /// Whether the polygon of a body gives what is not found on it. Two forces on one line give each other only; a link that
    /// has no more is told for its line.
    fn closes(&self, body: &FreeBody, group: Group<'_>) -> bool {
        // Beside a couple that a force is zero is what a polygon tells.
        let couples = body.acting.iter().any(|acting| acting.couple != 0.0);
        let sized = body.acting.iter().filter(|acting| couples || acting.force != [0.0; 2]);
        let sized: Vec<&Acting> = sized.collect();
        let open: Vec<usize> = sized.iter().map(|acting| self.open(acting)).collect();
        let one_line = sized.len() == 2 && body.torques.is_empty() && !couples;
        let of_member = |links: &&[LinkId]| body.links().iter().all(|link| links.contains(link));
        // Moments of the other link give it, and are told with it.
        let lent = |moments: &MomentBalance| match moments.found.of {
            Turning::Force(found) => sized.iter().any(|acting| same_pair(acting.action, found)),
            _ => false,
        };
        match open.contains(&0) {
            false if one_line => !group.members.iter().any(of_member) && group.moments.iter().any(lent),
            _ => open.iter().sum::<usize>() <= 2,
        }
    }

    /// Takes up what a polygon gives.
    fn learn(&mut self, body: &FreeBody) {
        self.found.extend(body.acting.iter().map(|acting| Part::Whole(acting.action)));
    }

    /// Takes up what the polygons of driven pins give that are cut free, once all links are shown that they join.
    fn learn_pins(&mut self, group: Group<'_>) {
        for pin in (0..self.mechanism.points.len()).map(PointId) {
            let Some((input, _)) = self.mechanism.drive_of_pin(pin) else { continue };
            let at_pin = |acting: &&Acting| {
                matches!(acting.action, Action::OfPin(of, _) if of == pin)
                    || [Action::Drive(input), Action::DriveBack(input)].contains(&acting.action)
            };
            let here: Vec<&Acting> =
                group.bodies.iter().flat_map(|body| &body.acting).filter(at_pin).collect();
            let cut_free = here.iter().any(|acting| matches!(acting.action, Action::OfPin(..)));
            let links = self.mechanism.parties_at(pin);
            let of_group = |link: &LinkId| group.bodies.iter().any(|body| body.has(*link));
            let shown = links.into_iter().filter(of_group).all(|link| self.shown.contains(&link));
            let open: usize = here.iter().map(|acting| self.open(acting)).sum();
            if cut_free && shown && (1..=2).contains(&open) {
                self.found.extend(here.iter().map(|acting| Part::Whole(acting.action)));
            }
        }
    }

    /// Takes up what moments give, so far as what they use is found.
    fn learn_moments<'a>(&mut self, all: impl Iterator<Item = &'a MomentBalance>) {
        let mut left: Vec<&MomentBalance> = all.collect();
        loop {
            let before = left.len();
            left.retain(|moments| {
                let known = moments.terms.iter().all(|term| self.has(term.of));
                if known {
                    self.found.extend(match moments.found.of {
                        Turning::Force(action) => Some(Part::Whole(action)),
                        Turning::Across(action) => Some(Part::Across(action)),
                        Turning::Along(action) => Some(Part::Along(action)),
                        Turning::Torque(_) => None,
                    });
                }
                !known
            });
            if left.len() == before {
                return;
            }
        }
    }

    fn has(&self, of: Turning) -> bool {
        let part = |is: fn(&Part) -> Option<Action>, action| {
            self.knows(action) || self.found.iter().filter_map(is).any(|found| same_pair(found, action))
        };
        match of {
            Turning::Force(action) => self.knows(action),
            Turning::Across(action) => part(across, action),
            Turning::Along(action) => part(along, action),
            Turning::Torque(_) => true,
        }
    }

    /// Whether these bodies, told together, leave nothing to be found on them; what they give is taken up.
    fn tells(&mut self, group: Group<'_>, chunk: &[usize]) -> bool {
        for body in chunk {
            let own = |moments: &&MomentBalance| told_at(group, *body, moments);
            self.learn_moments(group.moments.iter().filter(own));
        }
        let mut left = chunk.to_vec();
        self.shown.extend(chunk.iter().flat_map(|body| group.bodies[*body].links()));
        loop {
            let before = left.len();
            self.learn_pins(group);
            left.retain(|body| {
                let body = &group.bodies[*body];
                let closes = self.closes(body, group);
                let open = |acting: &Acting| acting.force != [0.0; 2] && self.open(acting) > 0;
                let learns = body.acting.len() != 2 || !body.acting.iter().all(open);
                if closes && learns {
                    self.learn(body);
                }
                !closes
            });
            if left.len() == before {
                return left.is_empty();
            }
        }
    }

    /// Whether each of these chunks of bodies leaves nothing to be found, one after the other.
    pub(super) fn tells_all(&self, group: Group<'_>, chunks: &[Vec<usize>]) -> bool {
        let mut told = self.clone();
        chunks.iter().all(|chunk| told.tells(group, chunk))
    }

    /// Chunks of bodies in an order in which each leaves nothing to be found, those that are told together in one chunk
    /// with the one whose polygon comes first as its last; none where there is no such order.
    pub(super) fn order(&self, group: Group<'_>) -> Option<Vec<Vec<usize>>> {
        let mut told = self.clone();
        let mut left: Vec<usize> = (0..group.bodies.len()).collect();
        let mut chunks = Vec::new();
        while !left.is_empty() {
            let alone = left.iter().map(|body| vec![*body]);
            let pairs = left.iter().flat_map(|last| {
                let others = left.iter().filter(move |first| *first != last);
                others.map(move |first| vec![*first, *last])
            });
            let next = alone.chain(pairs).chain([left.clone()]).find_map(|chunk| {
                let mut after = told.clone();
                after.tells(group, &chunk).then_some((chunk, after))
            });
            let (chunk, after) = next?;
            left.retain(|body| !chunk.contains(body));
            chunks.push(chunk);
            told = after;
        }
        Some(chunks)
    }
}

/// Whether moments are told at a body: as one of those of which they are taken, or as the one that needs them first.
fn told_at(group: Group<'_>, body: usize, moments: &MomentBalance) -> bool {
    let of = |body: &FreeBody| moments.links.iter().any(|link| body.has(*link));
    of(&group.bodies[body]) || moments.told == body
}

fn whole(part: &Part) -> Option<Action> {
    if let Part::Whole(action) = part { Some(*action) } else { None }
}

fn along(part: &Part) -> Option<Action> {
    if let Part::Along(action) = part { Some(*action) } else { None }
}

fn across(part: &Part) -> Option<Action> {
    if let Part::Across(action) = part { Some(*action) } else { None }
}
