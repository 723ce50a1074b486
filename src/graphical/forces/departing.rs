//! Where somebody's balance departs from the right one: what he lays off, what he leaves out, what he reads.

use crate::board::{Amount, Direction, Scale};
use crate::given::Given;
use crate::mechanism::force::{Action, Mass, Party, Share};
use crate::mechanism::{LinkId, PointId};

use super::super::departure::{Departure, Twist};
use super::super::draughtsman::Draughtsman;
use super::{Balance, Item, Pull};

impl Draughtsman<'_> {
    /// A force laid off otherwise, about its tail.
    fn twisted(&mut self, pull: Pull, twist: Twist) -> Pull {
        let [x, y] = self.components_of(pull);
        let (sin, cos) = (twist.factor * libm::sin(twist.turn), twist.factor * libm::cos(twist.turn));
        let [sin, cos] = [sin, cos].map(|part| self.board.amount(Given::exact(part)));
        let (xc, ys) = (self.board.product(x, cos), self.board.product(y, sin));
        let (xs, yc) = (self.board.product(x, sin), self.board.product(y, cos));
        let parts = [self.board.difference(xc, ys), self.board.sum(xs, yc)];
        let scale = self.force_scale();
        let by = parts.map(|part| self.board.to_paper(part, scale));
        Pull { tail: pull.tail, head: self.board.moved(pull.tail, by) }
    }

    fn times(&mut self, amount: Amount, factor: f64) -> Amount {
        let factor = self.board.amount(Given::exact(factor));
        self.board.product(amount, factor)
    }

    /// An inertia force as it is laid off.
    pub(super) fn inertia_as_laid_off(&mut self, link: LinkId, pull: Pull) -> Pull {
        let twists = self.departures.iter().filter_map(|departure| match *departure {
            Departure::InertiaForce { link: of, twist } if of.is_none_or(|of| of == link) => Some(twist),
            _ => None,
        });
        let twist = twists.reduce(|a, b| Twist { factor: a.factor * b.factor, turn: a.turn + b.turn });
        match twist {
            Some(twist) => self.twisted(pull, twist),
            None => pull,
        }
    }

    /// −I ε as it is reckoned.
    pub(super) fn torque_as_reckoned(&mut self, link: LinkId, torque: Amount) -> Amount {
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::InertiaTorque { link: of, factor } if of.is_none_or(|of| of == link) => Some(factor),
            _ => None,
        });
        match factors.reduce(|a, b| a * b) {
            Some(factor) => self.times(torque, factor),
            None => torque,
        }
    }

    /// The couple by which an inertia force is shifted from its mass centre.
    pub(super) fn inertia_couple(&mut self, mass: &Mass) -> Option<Amount> {
        let torque = self.inertia_torque(mass)?;
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::Offset { link, factor } if link.is_none_or(|of| of == mass.link) => Some(factor),
            _ => None,
        });
        Some(match factors.reduce(|a, b| a * b) {
            Some(factor) => self.times(torque, factor),
            None => torque,
        })
    }

    /// A weight as it is laid off.
    pub(super) fn weight_as_laid_off(&mut self, link: LinkId, size: Amount) -> Amount {
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::Weight { link: of, factor } if of.is_none_or(|of| of == link) => Some(factor),
            _ => None,
        });
        match factors.reduce(|a, b| a * b) {
            Some(factor) => self.times(size, factor),
            None => size,
        }
    }

    /// What is laid off of all that acts.
    pub(super) fn share_as_laid_off(&self, share: Share) -> Share {
        let only = self.departures.iter().find_map(|departure| match *departure {
            Departure::OnlyShare(only) => Some(only),
            _ => None,
        });
        if share == Share::Total { only.unwrap_or(share) } else { share }
    }

    /// Lays off what somebody has acting besides, and beside what acts.
    pub(super) fn lay_off_beside(&mut self, balance: &mut Balance) {
        for index in 0..self.departures.len() {
            let Departure::Beside { link, force, at, couple } = self.departures[index] else { continue };
            let [forces, lengths] = [self.force_scale(), self.length_scale()];
            let tail = self.board.origin();
            let [fx, fy] = force.map(|part| self.exact_on_paper(part, forces));
            let [x, y] = at.map(|part| self.exact_on_paper(part, lengths));
            let pull = Pull { tail, head: self.board.moved(tail, [fx, fy]) };
            let at = self.board.moved(tail, [x, y]);
            let couple = self.board.amount(Given::exact(couple));
            balance.known[link.0].push(Item { pull: Some(pull), at, couple: Some(couple) });
        }
    }

    fn exact_on_paper(&mut self, si: f64, scale: Scale) -> crate::board::Mm {
        let amount = self.board.amount(Given::exact(si));
        self.board.to_paper(amount, scale)
    }

    /// The line of a guide's force as it is drawn.
    pub(super) fn guide_force_as_drawn(&mut self, slide: usize, normal: Direction) -> Direction {
        let stated = self.departures.iter().find_map(|departure| match *departure {
            Departure::GuideForce { slide: of, along } if of == slide => Some(along),
            _ => None,
        });
        match stated {
            Some(along) => {
                let along = self.board.angle(Given::exact(along));
                self.board.protractor(along)
            }
            None => normal,
        }
    }

    /// The radius of a friction circle, in the sense of the turning, as it is drawn.
    pub(super) fn circle_as_drawn(&mut self, pin: PointId, radius: Amount) -> Amount {
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::FrictionCircle { pin: of, factor } if of == pin => Some(factor),
            _ => None,
        });
        match factors.reduce(|a, b| a * b) {
            Some(factor) => self.times(radius, factor),
            None => radius,
        }
    }

    /// tan φ of a guide, in the sense of the sliding, as it is drawn.
    pub(super) fn leaning_as_drawn(&mut self, slide: usize, tangent: Amount) -> Amount {
        let factors = self.departures.iter().filter_map(|departure| match *departure {
            Departure::FrictionAngle { slide: of, factor } if of == slide => Some(factor),
            _ => None,
        });
        match factors.reduce(|a, b| a * b) {
            Some(factor) => self.times(tangent, factor),
            None => tangent,
        }
    }

    /// The force of a pin on a link as it is used from here on.
    pub(super) fn pin_force_as_used(&mut self, pin: PointId, link: LinkId, found: Pull) -> Pull {
        let parties = self.mechanism.parties_at(pin);
        let stated = self.departures.iter().rev().find_map(|departure| {
            let Departure::ForceIs { action, force } = *departure else { return None };
            let sign =
                match action {
                    Action::OfPin(of, on) if (of, on) == (pin, link) => 1.0,
                    Action::OnPin(by, of) if (of, by) == (pin, link) => -1.0,
                    Action::Pair { by, on }
                        if parties.len() == 2 && parties.contains(&by) && parties.contains(&on) =>
                    {
                        if on == link { 1.0 } else { -1.0 }
                    }
                    _ => return None,
                };
            Some(force.map(|part| sign * part))
        });
        self.used(stated, found)
    }

    /// The force of a sliding pair on its inner side as it is used from here on.
    pub(super) fn slide_force_as_used(&mut self, slide: usize, inner: Option<LinkId>, found: Pull) -> Pull {
        let pair = self.mechanism.slides[slide];
        let (Party::Link(rider), guide) = (self.mechanism.party_of(&pair.rider), pair.guide.link) else {
            return found;
        };
        let stated = self.departures.iter().rev().find_map(|departure| {
            let Departure::ForceIs { action: Action::Pair { by, on }, force } = *departure else {
                return None;
            };
            let between = [[rider, guide], [guide, rider]].contains(&[by, on]);
            let only = self.mechanism.pairs_between(by, on).len() == 1;
            let sign = if inner == Some(on) { 1.0 } else { -1.0 };
            (between && only).then(|| force.map(|part| sign * part))
        });
        self.used(stated, found)
    }

    fn used(&mut self, stated: Option<[f64; 2]>, found: Pull) -> Pull {
        let Some(force) = stated else { return found };
        let scale = self.force_scale();
        let by = force.map(|part| self.exact_on_paper(part, scale));
        Pull { tail: found.tail, head: self.board.moved(found.tail, by) }
    }
}
