//! What is given, laid off: loads, weights, inertia, springs.

use crate::board::{Amount, Direction, Reason};
use crate::given::Given;
use crate::mechanism::force::{
    Area, Heaviness, Inertia, Load, LoadKind, Mass, Pointing, Pressure, Share, Size, Sought, SpringKind,
    SpringLaw, Unaimed,
};
use crate::mechanism::quantity::Order;
use crate::mechanism::spin::SpinSpeed;
use crate::mechanism::{Input, LinkId, PointId};
use crate::plan::Plan;

use super::super::curve::Curved;
use super::super::draughtsman::Draughtsman;
use super::super::missing::Missing;
use super::{Balance, Item, Pull};

/// Lays off everything that acts on the links of a plan.
pub(super) fn lay_off(d: &mut Draughtsman<'_>, plan: &Plan, share: Share, balance: &mut Balance) {
    let forces = d.mechanism.forces.clone();
    let drawn = |link: LinkId| plan.forces.links.contains(&link);
    for (index, load) in forces.loads.iter().enumerate().filter(|(_, load)| drawn(load.link)) {
        if load.is_sought() || share != Share::Inertia {
            let assumed = balance.assumed.iter().find(|(s, _)| *s == Sought::Load(index)).map(|(_, a)| *a);
            if load.is_sought() && assumed.is_none() {
                continue;
            }
            let item = d.load(load, assumed);
            let item = d.part_of_shared(load.link, item);
            balance.known[load.link.0].push(item);
        }
    }
    for (index, spring) in forces.springs.iter().enumerate() {
        if share == Share::Inertia && !spring.is_sought() {
            continue;
        }
        let assumed = balance.assumed.iter().find(|(s, _)| *s == Sought::Spring(index)).map(|(_, a)| *a);
        if spring.is_sought() && assumed.is_none() {
            continue;
        }
        let ends = match spring.kind {
            SpringKind::Pull(ends) => ends,
            SpringKind::Torsion(links) => {
                if links.into_iter().any(drawn) {
                    let torque = d.spring_torque(spring.law, links, assumed);
                    d.lay_off_torsion(links, torque, balance);
                }
                continue;
            }
        };
        if !ends.iter().any(|(link, _)| drawn(*link)) {
            continue;
        }
        let pull = d.spring_pull(spring.law, ends.map(|(_, point)| point), assumed);
        let [first, second] = ends.map(|(_, point)| d.at(point));
        let reason = d.reason_missing(Missing::Aim(Unaimed::Spring(index)));
        let (toward, _) = d.board.toward(first, second, reason);
        let on_first = d.pull_along(toward, pull);
        let items = [(first, on_first), (second, Draughtsman::opposite(on_first))];
        // A spring on what all halves share is shared too.
        let shared = ends.iter().map(|(link, _)| *link).find(|link| d.mechanism.shared_by(*link) != 1.0);
        for ((link, _), (at, pull)) in ends.into_iter().zip(items) {
            let item = Item { pull: Some(pull), at, couple: None };
            let item = d.part_of_shared(shared.unwrap_or(link), item);
            balance.known[link.0].push(item);
        }
    }
    if let Some(spin) = &forces.spin {
        let sought = spin.omega == SpinSpeed::Sought;
        let assumed = balance.assumed.iter().find(|(s, _)| *s == Sought::Spin).map(|(_, a)| *a);
        for mass in forces.masses.iter().filter(|mass| drawn(mass.link)) {
            if (sought || share != Share::Static)
                && let Some(item) = d.centrifugal(spin, mass, assumed)
            {
                let item = d.part_of_shared(mass.link, item);
                balance.known[mass.link.0].push(item);
            }
        }
        if share != Share::Inertia {
            d.lay_off_drag(spin, share, balance);
        }
    }
    for mass in forces.masses.iter().filter(|mass| drawn(mass.link)) {
        let at = d.at(mass.centre);
        if share != Share::Inertia
            && let Some(pull) = d.weight(mass)
        {
            let item = d.part_of_shared(mass.link, Item { pull: Some(pull), at, couple: None });
            balance.known[mass.link.0].push(item);
        }
        if share != Share::Static {
            let (pull, couple) = (d.inertia_force(mass), d.inertia_couple(mass));
            if pull.is_some() || couple.is_some() {
                let item = d.part_of_shared(mass.link, Item { pull, at, couple });
                balance.known[mass.link.0].push(item);
            }
        }
    }
}

impl Draughtsman<'_> {
    /// A couple on each link of a torsion spring: `torque` on the second one.
    fn lay_off_torsion(&mut self, links: [LinkId; 2], torque: Amount, balance: &mut Balance) {
        let back = self.board.opposite(torque);
        // A spring on what all halves of a governor share is shared too.
        let shared = links.into_iter().find(|link| self.mechanism.shared_by(*link) != 1.0);
        for (link, couple) in links.into_iter().zip([back, torque]) {
            // A couple acts wherever one likes on its link.
            let at = match self.mechanism.link(link).points.first() {
                Some(&joint) => self.at(joint),
                None => self.no_point(Missing::Joint(link)),
            };
            let item = Item { pull: None, at, couple: Some(couple) };
            let item = self.part_of_shared(shared.unwrap_or(link), item);
            balance.known[link.0].push(item);
        }
    }

    /// The mass of a link; none of a flywheel.
    pub(in super::super) fn kilograms(&mut self, mass: &Mass) -> Option<Amount> {
        match mass.heaviness {
            Heaviness::Mass(given) => Some(self.board.amount(given)),
            Heaviness::Weight(weight) => {
                let weight = self.board.amount(weight);
                let g = self.board.amount(self.mechanism.forces.gravity.g);
                let reason = self.reason(&[mass.link]);
                Some(self.board.quotient(weight, g, reason))
            }
            Heaviness::None => None,
        }
    }

    pub(super) fn weight(&mut self, mass: &Mass) -> Option<Pull> {
        let gravity = self.mechanism.forces.gravity;
        if !gravity.acts {
            return None;
        }
        let size = match mass.heaviness {
            Heaviness::Weight(weight) => self.board.amount(weight),
            Heaviness::Mass(given) => {
                let (mass, g) = (self.board.amount(given), self.board.amount(gravity.g));
                self.board.product(mass, g)
            }
            Heaviness::None => return None,
        };
        let size = self.weight_as_laid_off(mass.link, size);
        let angle = self.board.angle(gravity.direction);
        let down = self.board.protractor(angle);
        Some(self.pull_along(down, size))
    }

    /// −M A_G, laid off against o′g′; none where the mass centre is fixed or there is no mass.
    pub(in super::super) fn inertia_force(&mut self, mass: &Mass) -> Option<Pull> {
        if self.mechanism.is_fixed(mass.centre) || self.mechanism.rests_in_its_plane() {
            return None;
        }
        let kilograms = self.kilograms(mass)?;
        let image = self.image(Order::Acceleration, mass.centre);
        let pole = self.board.origin();
        let (from, to) = (self.polygon_scale(Order::Acceleration), self.force_scale());
        let against = self.board.between(image, pole);
        let by = against.map(|part| {
            let part = self.board.read(part, from);
            let part = self.board.product(part, kilograms);
            self.board.to_paper(part, to)
        });
        let pull = Pull { tail: pole, head: self.board.moved(pole, by) };
        Some(self.inertia_as_laid_off(mass.link, pull))
    }

    /// The moment of inertia about the mass centre; none of a point mass.
    pub(in super::super) fn central_inertia(&mut self, mass: &Mass) -> Option<Amount> {
        match mass.inertia {
            Inertia::Point => None,
            Inertia::Central(given) => Some(self.board.amount(given)),
            Inertia::Gyration(radius) => {
                let radius = self.board.amount(radius);
                let square = self.board.product(radius, radius);
                let kilograms = self.kilograms(mass)?;
                Some(self.board.product(kilograms, square))
            }
            Inertia::About(point, given) => {
                let about = self.board.amount(given);
                let Some(kilograms) = self.kilograms(mass) else { return Some(about) };
                if point == mass.centre {
                    return Some(about);
                }
                let (a, b) = (self.own(mass.link, mass.centre), self.own(mass.link, point));
                let mm = self.board.distance(a, b);
                let scale = self.length_scale();
                let away = self.board.read(mm, scale);
                let square = self.board.product(away, away);
                let moved = self.board.product(kilograms, square);
                Some(self.board.difference(about, moved))
            }
        }
    }

    /// −I ε; none where the link cannot turn or has no moment of inertia.
    pub(in super::super) fn inertia_torque(&mut self, mass: &Mass) -> Option<Amount> {
        if self.translates[mass.link.0] || self.mechanism.rests_in_its_plane() {
            return None;
        }
        let inertia = self.central_inertia(mass)?;
        let alpha = self.rate(Order::Acceleration, mass.link);
        let torque = self.board.product(inertia, alpha);
        let torque = self.board.opposite(torque);
        Some(self.torque_as_reckoned(mass.link, torque))
    }

    fn size(&mut self, size: Size, assumed: Option<Amount>) -> Amount {
        match size {
            Size::Given(given) => self.board.amount(given),
            Size::Curve(curve) => self.height_of_curve(curve),
            Size::Sought => assumed.unwrap_or_else(|| self.no_amount(Missing::Sought)),
            Size::Pressure { pressure, area } => {
                let pressure = match pressure {
                    Pressure::Given(given) => self.board.amount(given),
                    Pressure::Curve(curve) => self.height_of_curve(curve),
                };
                let area = self.area(area);
                self.board.product(pressure, area)
            }
        }
    }

    /// The height of a curve at the angle of the first input.
    pub(super) fn height_of_curve(&mut self, curve: usize) -> Amount {
        let at = self.angle_of_input();
        let curve = self.mechanism.forces.curves[curve].clone();
        let links = self.mechanism.driven_link(0);
        let reason = self.reason(links.as_slice());
        let curve = Curved::new(&mut self.board, &curve);
        curve.height_here(&mut self.board, at, reason)
    }

    /// The angle of the first input, radians: as it is given, or measured within a turn from +x.
    pub(super) fn angle_of_input(&mut self) -> Amount {
        let (link, angle) = match self.mechanism.inputs.first() {
            Some(Input::Angle { link, angle, .. } | Input::Speed { link, angle, .. }) => (*link, *angle),
            Some(Input::Slide { .. }) | None => return self.no_amount(Missing::Input(0)),
        };
        if let Some(angle) = angle {
            let angle = self.board.input_angle(0, angle);
            return self.board.radians(angle);
        }
        let own = self.own_line_of(link);
        let along = self.carried(link, own);
        let angle = self.board.measure_angle(along);
        let angle = self.board.radians(angle);
        if angle.value() >= 0.0 {
            return angle;
        }
        let turn = crate::double_double::DoubleDouble::PI * crate::double_double::DoubleDouble::of(2.0);
        let turn = self.board.amount(Given::fine(turn, 1e-31));
        self.board.sum(angle, turn)
    }

    /// The torque of a torsion spring on its second link: against how much further that is turned against the first one
    /// than without load, within half a turn where it stands.
    pub(super) fn spring_torque(
        &mut self,
        law: SpringLaw,
        links: [LinkId; 2],
        assumed: Option<Amount>,
    ) -> Amount {
        match law {
            SpringLaw::Force(size) => self.size(size, assumed),
            SpringLaw::Stiffness { stiffness, free } => {
                let further = self.further_turned(links, free);
                let stiffness = self.size(stiffness, assumed);
                let back = self.board.product(stiffness, further);
                self.board.opposite(back)
            }
        }
    }

    /// How much further the second link is turned against the first than by this angle, radians.
    pub(super) fn further_turned(&mut self, links: [LinkId; 2], free: Given) -> Amount {
        let right = self.board.rightward();
        let [first, second] = links.map(|link| self.carried(link, right));
        let free = self.board.angle(free);
        let without = self.board.turned(first, free);
        let further = self.board.turned_since(without, second);
        self.board.radians(further)
    }

    fn area(&mut self, area: Area) -> Amount {
        let (bore, rod) = match area {
            Area::Given(given) => return self.board.amount(given),
            Area::Bore { bore, rod } => (bore, rod),
        };
        let square = |d: &mut Self, given: Given| {
            let length = d.board.amount(given);
            d.board.product(length, length)
        };
        let mut sum = square(self, bore);
        if let Some(rod) = rod {
            let less = square(self, rod);
            sum = self.board.difference(sum, less);
        }
        let pi = crate::double_double::DoubleDouble::PI;
        let quarter = Given::fine(pi * crate::double_double::DoubleDouble::of(0.25), 1e-32);
        let quarter = self.board.amount(quarter);
        self.board.product(quarter, sum)
    }

    /// A load as it acts on its link.
    pub(super) fn load(&mut self, load: &Load, assumed: Option<Amount>) -> Item {
        match load.kind {
            LoadKind::Torque { size, with_motion } => {
                let mut torque = self.size(size, assumed);
                if let Some(with) = with_motion {
                    let omega = self.rate(Order::Velocity, load.link);
                    let reason = self.reason_of_load(load);
                    torque = self.board.in_sense_of(torque, omega, reason);
                    if !with {
                        torque = self.board.opposite(torque);
                    }
                }
                // A couple acts wherever one likes on its link.
                let at = match self.mechanism.link(load.link).points.first() {
                    Some(&joint) => self.at(joint),
                    None => self.no_point(Missing::Joint(load.link)),
                };
                Item { pull: None, at, couple: Some(torque) }
            }
            LoadKind::Vector { at, parts, of } => {
                let scale = self.force_scale();
                let [x, y] = parts.map(|given| {
                    let amount = self.board.amount(given);
                    self.board.to_paper(amount, scale)
                });
                let tail = self.board.origin();
                let head = if of == LinkId::FRAME {
                    self.board.prick(x, y)
                } else {
                    let right = self.board.rightward();
                    let own_x = self.carried(of, right);
                    let own_y = self.board.quarter_turn(own_x);
                    let foot = self.board.lay_off(tail, own_x, x);
                    self.board.lay_off(foot, own_y, y)
                };
                Item { pull: Some(Pull { tail, head }), at: self.at(at), couple: None }
            }
            LoadKind::Force { at, size, pointing } => {
                let size = self.size(size, assumed);
                let reason = self.reason_of_load(load);
                let along = self.pointing(pointing, at, reason);
                let pull = self.pull_along(along, size);
                Item { pull: Some(pull), at: self.at(at), couple: None }
            }
        }
    }

    /// For which reason a load may have no direction.
    fn reason_of_load(&mut self, load: &Load) -> Reason {
        match self.mechanism.forces.loads.iter().position(|other| other.name == load.name) {
            Some(index) => self.reason_missing(Missing::Aim(Unaimed::Load(index))),
            None => self.reason(&[load.link]),
        }
    }

    fn pointing(&mut self, pointing: Pointing, at: PointId, reason: Reason) -> Direction {
        match pointing {
            Pointing::World(angle) => {
                let angle = self.board.angle(angle);
                self.board.protractor(angle)
            }
            Pointing::Between { from, to, turned } => {
                let (a, b) = (self.at(from), self.at(to));
                let (along, _) = self.board.toward(a, b, reason);
                if turned == Given::exact(0.0) {
                    return along;
                }
                let by = self.board.angle(turned);
                self.board.turned(along, by)
            }
            Pointing::Own { link, angle } => {
                let angle = self.board.angle(angle);
                let own = self.board.protractor(angle);
                if link == LinkId::FRAME { own } else { self.carried(link, own) }
            }
            Pointing::Motion { with } => {
                let image = self.image(Order::Velocity, at);
                let pole = self.board.origin();
                let (along, _) = self.board.toward(pole, image, reason);
                if with { along } else { self.board.reverse(along) }
            }
        }
    }

    /// The pull of a spring between two points.
    pub(super) fn spring_pull(
        &mut self,
        law: SpringLaw,
        ends: [PointId; 2],
        assumed: Option<Amount>,
    ) -> Amount {
        match law {
            SpringLaw::Force(size) => self.size(size, assumed),
            SpringLaw::Stiffness { stiffness, free } => {
                let [first, second] = ends.map(|point| self.at(point));
                let mm = self.board.distance(first, second);
                let scale = self.length_scale();
                let length = self.board.read(mm, scale);
                let free = self.board.amount(free);
                let longer = self.board.difference(length, free);
                let stiffness = self.size(stiffness, assumed);
                self.board.product(stiffness, longer)
            }
        }
    }
}
