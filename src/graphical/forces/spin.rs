//! Governors: M ω² r of every mass, square to the axis and away from it, and the drag of the sleeve.

use crate::board::{Amount, Line, Reason};
use crate::given::Given;
use crate::mechanism::LinkId;
use crate::mechanism::force::{Mass, Share};
use crate::mechanism::spin::{Drag, Spin, SpinSpeed};

use super::super::draughtsman::Draughtsman;
use super::{Balance, Item, Pull};

/// The drag of a sleeve that rests has no sense.
pub(super) const RESTS: &str =
    "the sleeve rests, and its drag has no sense: ask for spin(rising) and spin(falling)";
/// ω² would be below zero.
pub(in super::super) const NO_SPEED: &str =
    "at no speed is there equilibrium: what acts pulls the balls outward, and ω² would be below zero";

impl Draughtsman<'_> {
    /// ω² of the plane, given or assumed.
    fn spin_squared(&mut self, spin: &Spin, assumed: Option<Amount>) -> Option<Amount> {
        match spin.omega {
            SpinSpeed::Given(omega) => {
                let omega = self.board.amount(omega);
                Some(self.board.product(omega, omega))
            }
            SpinSpeed::Sought => assumed,
        }
    }

    /// ω² as the square of a speed, none below zero: nothing that hangs on it is a force then. Led to where it is below zero
    /// it divides by a root that is none.
    pub(super) fn square_of_a_speed(&mut self, square: Amount, reason: Reason) -> Option<Amount> {
        if square.value() <= 0.0 {
            return (square.value() == 0.0).then_some(square);
        }
        let root = self.board.root(square);
        let speed = self.board.quotient(square, root, reason);
        Some(self.board.product(speed, root))
    }

    /// M ω² r of a mass, away from the axis; none of a flywheel.
    pub(super) fn centrifugal(&mut self, spin: &Spin, mass: &Mass, assumed: Option<Amount>) -> Option<Item> {
        let kilograms = self.kilograms(mass)?;
        let square = self.spin_squared(spin, assumed)?;
        let at = self.at(mass.centre);
        let through = self.prick_world(spin.through);
        let angle = self.board.angle(spin.angle);
        let along = self.board.protractor(angle);
        // How far the mass centre lies from the axis, to its left positive.
        let [_, across] = self.board.square_off(Line { through, along }, at);
        let scale = self.length_scale();
        let radius = self.board.read(across, scale);
        let per_radius = self.board.product(kilograms, square);
        let size = self.board.product(per_radius, radius);
        let left = self.board.quarter_turn(along);
        let pull = self.pull_along(left, size);
        Some(Item { pull: Some(pull), at, couple: None })
    }

    /// What counts in the half that is drawn of something that all halves share.
    pub(super) fn part_of_shared(&mut self, link: LinkId, item: Item) -> Item {
        let halves = self.mechanism.shared_by(link);
        if halves == 1.0 {
            return item;
        }
        let halves = self.board.amount(Given::exact(halves));
        let reason = self.reason(&[link]);
        let scale = self.force_scale();
        let pull = item.pull.map(|pull| {
            let parts = self.components_of(pull).map(|part| {
                let part = self.board.quotient(part, halves, reason);
                self.board.to_paper(part, scale)
            });
            let tail = self.board.origin();
            Pull { tail, head: self.board.moved(tail, parts) }
        });
        let couple = item.couple.map(|couple| self.board.quotient(couple, halves, reason));
        Item { pull, couple, ..item }
    }

    /// Lays the drag of the sleeve off, against its motion.
    pub(super) fn lay_off_drag(&mut self, spin: &Spin, share: Share, balance: &mut Balance) {
        if let Some(drag) = spin.drag {
            self.lay_off_given_drag(spin, drag, share, balance);
        }
    }

    fn lay_off_given_drag(&mut self, spin: &Spin, drag: Drag, share: Share, balance: &mut Balance) {
        let item = match self.drag_on_sleeve(spin, drag, share) {
            Ok(item) => item,
            Err(why) => {
                balance.refused = Some(why);
                return;
            }
        };
        let slide = self.mechanism.slides[drag.slide];
        let item = match spin.sleeve {
            Some(sleeve) => self.part_of_shared(sleeve, item),
            None => item,
        };
        let against = Item { pull: item.pull.map(Self::opposite), ..item };
        balance.push_on(self.mechanism.party_of(&slide.rider), item);
        balance.known[slide.guide.link.0].push(against);
    }

    /// The whole drag on the sleeve, against its motion.
    pub(super) fn drag_on_sleeve(
        &mut self,
        spin: &Spin,
        drag: Drag,
        share: Share,
    ) -> Result<Item, &'static str> {
        let sense = spin.sense(share, self.mechanism).ok_or(RESTS)?;
        let pin = self.mechanism.pin_of_slide(drag.slide).ok_or("the sleeve has no joint in its guide")?;
        let at = self.at(pin);
        let (along, _) = self.guide_at(drag.slide, at);
        let mut size = self.board.amount(drag.size);
        if sense > 0.0 {
            size = self.board.opposite(size);
        }
        Ok(Item { pull: Some(self.pull_along(along, size)), at, couple: None })
    }
}
