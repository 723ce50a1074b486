//! The typical mistakes of a balance of forces and of a turning-moment diagram, as what each changes.

use std::f64::consts::FRAC_PI_2;

use super::answers::Given;
use super::case::polygon;
use super::change::{Change, InputChange, Misreading, Which};
use super::kind::Kind;
use super::misread::Guideway;
use super::mistakes::{Hypothesis, List, PLAIN, apart, one_of};
use super::phrase::{Phrase, say};
use crate::graphical::construction::{About, Acting, ForceSheet, Label, MomentBalance, Turning};
use crate::graphical::{Departure, Twist};
use crate::mechanism::curve::Curve;
use crate::mechanism::cycle::{Course, CycleQuantity, RotatingInertia, Sides};
use crate::mechanism::force::{
    Action, Area, Force, Heaviness, Inertia, LoadKind, Mass, Party, Pointing, Share, Size,
};
use crate::mechanism::friction::{FrictionCircle, Resistance, Roughness, RubbingPair};
use crate::mechanism::quantity::{Order, Quantity};
use crate::mechanism::{Input, LinkId, PointId, Rider, Slide};

/// An arm that differs from the distance of the pin by less than this part is that distance.
const SAME_ARM: f64 = 0.03;
/// Where somebody takes an arm in centimetres of the drawing for metres, or in its millimetres.
const UNITS_OF_ARMS: [f64; 3] = [1.0, 100.0, 1000.0];

/// A coefficient of friction that is found by what was handed in is a free number.
const FOUND: f64 = 1.5;
/// No coefficient of friction is taken for a larger one.
const MOST_FRICTION: f64 = 1.0;

/// A force as it stands on one body, with the moments in which it has its part.
struct Standing<'s> {
    link: LinkId,
    acting: &'s Acting,
    balance: Option<&'s MomentBalance>,
}

impl List<'_, '_> {
    /// What may be wrong with a balance as it stands.
    pub(super) fn forces(&mut self, sheet: &ForceSheet) {
        self.inertia(sheet);
        self.weights_and_masses();
        self.all_weights();
        self.loads_elsewhere(sheet);
        self.loads_calculated();
        self.loads_turned();
        self.parallel_axes();
        self.left_out(sheet);
        self.handed_on_reversed(sheet);
        self.arms(sheet);
        self.arms_of_the_drawing();
        self.torques(sheet);
        self.offsets_inverted();
        self.guides(sheet);
        self.square_parts(sheet);
        self.friction();
        self.shares();
        self.shaking(sheet);
    }

    fn force_name(&self, force: Force) -> String {
        self.name(&Quantity::Force(force, Share::Total))
    }

    // --- inertia -------------------------------------------------------------------------------

    fn inertia(&mut self, sheet: &ForceSheet) {
        let masses = self.case.mechanism.forces.masses.clone();
        let moves = |mass: &&crate::mechanism::force::Mass| !self.case.mechanism.is_fixed(mass.centre);
        let links: Vec<Option<LinkId>> =
            masses.iter().filter(moves).map(|mass| Some(mass.link)).chain([None]).collect();
        let several = links.len() > 2;
        for link in links.into_iter().filter(|link| link.is_some() || several) {
            let at = match link {
                Some(link) => self.force_name(Force::Vector(Action::Inertia(link))).into(),
                None => say!("every inertia force"),
            };
            let price = if link.is_some() { PLAIN } else { 0.5 };
            let back = Departure::InertiaForce { link, twist: Twist::scaled(-1.0) };
            // The force alone, or its couple with it.
            let none = Departure::InertiaForce { link, twist: Twist::scaled(0.0) };
            let couple = Departure::InertiaTorque { link, factor: 0.0 };
            let left_out = |departures: Vec<Departure>| Change::drawn(departures);
            self.add(Kind::ForceLeftOut, &at, None, price, left_out(vec![none]));
            let how = (Kind::ForceLeftOut, say!("with its couple"));
            self.add_so(how, &at, None, price + 0.25, left_out(vec![none, couple]));
            self.add(Kind::InertiaAlongAcceleration, &at, None, price, Change::drawn(vec![back]));
            // The acceleration in millimetres or centimetres times kilograms.
            let unit = self.case.scene.units.length.si;
            if (unit - 1.0).abs() > 1e-9 {
                let twist = Twist::scaled(1.0 / unit);
                let force = Departure::InertiaForce { link, twist };
                self.add(Kind::MetreMixed, &at, None, price + 0.5, Change::drawn(vec![force]));
            }
            // With the couple on the side on which it should be of the force that should be.
            let with_couple = vec![back, Departure::Offset { link, factor: -1.0 }];
            self.add(Kind::InertiaAlongAcceleration, &at, None, price + 0.5, Change::drawn(with_couple));
            // With its torque along α, on the side on which it should be.
            let with_torque = vec![back, Departure::InertiaTorque { link, factor: -1.0 }];
            let how = (Kind::InertiaAlongAcceleration, say!("with its couple"));
            self.add_so(how, &at, None, price + 0.25, Change::drawn(with_torque));
        }
        for mass in masses.iter().filter(moves) {
            self.acceleration_of_another(mass);
        }
        let turns = |mass: &&crate::mechanism::force::Mass| mass.inertia != Inertia::Point;
        let links: Vec<Option<LinkId>> =
            masses.iter().filter(turns).map(|mass| Some(mass.link)).chain([None]).collect();
        let several = links.len() > 2;
        for link in links.into_iter().filter(|link| link.is_some() || several) {
            let [offset, couple] = match link {
                Some(link) => {
                    [Force::Offset(link), Force::InertiaTorque(link)].map(|of| self.force_name(of).into())
                }
                None => [say!("every offset"), say!("every inertia torque")],
            };
            let price = if link.is_some() { PLAIN } else { 0.5 };
            let side = vec![Departure::Offset { link, factor: -1.0 }];
            self.add(Kind::OffsetOtherSide, &offset, None, price, Change::drawn(side));
            let sense = vec![Departure::InertiaTorque { link, factor: -1.0 }];
            self.add(Kind::CoupleWithAlpha, &couple, None, price + 0.1, Change::drawn(sense));
            let none = vec![Departure::Offset { link, factor: 0.0 }];
            self.add(Kind::ForceLeftOut, &couple, None, price + 0.25, Change::drawn(none));
            // Not found at all: it and its offset are nothing.
            let not_found = vec![Departure::InertiaTorque { link, factor: 0.0 }];
            self.add(Kind::ForceLeftOut, &couple, None, price + 0.5, Change::drawn(not_found));
        }
        for mass in masses.iter().filter(turns) {
            self.inertia_torque(mass, sheet);
        }
    }

    /// M·A with the acceleration of another point of the link than its mass centre.
    fn acceleration_of_another(&mut self, mass: &Mass) {
        let Some(polygon) = polygon(self.construction, Order::Acceleration) else { return };
        let image = |point: PointId| {
            let label = Label::Image { point, link: None };
            polygon.images.iter().rev().find(|image| image.label == label).map(|image| image.at)
        };
        let Some([x, y]) = image(mass.centre) else { return };
        let own = libm::hypot(x, y);
        let name = self.force_name(Force::Vector(Action::Inertia(mass.link)));
        for point in self.case.mechanism.link(mass.link).points.clone() {
            let Some([u, v]) = image(point).filter(|_| point != mass.centre) else { continue };
            let turn = libm::atan2(x * v - y * u, x * u + y * v);
            let twist = Twist { factor: libm::hypot(u, v) / own, turn };
            if twist.factor.is_finite() && twist.factor > 0.0 {
                let force = Departure::InertiaForce { link: Some(mass.link), twist };
                let how = say!("with the acceleration of {}", self.case.mechanism.point(point).name);
                self.add_so((Kind::WrongFormula, how), &name, None, 0.75, Change::drawn(vec![force]));
            }
        }
    }

    /// An inertia torque that was found rightly and left out of the balance of its link, and one with the diameter of
    /// gyration.
    fn inertia_torque(&mut self, mass: &Mass, sheet: &ForceSheet) {
        let link = mass.link;
        let name = self.force_name(Force::InertiaTorque(link));
        // N·mm for N·m, kg·cm² or kg·mm² for kg·m².
        for (factor, price) in [(1e3, 0.5), (1e4, 0.75), (1e6, 0.75)] {
            for factor in [factor, 1.0 / factor] {
                let torque = Departure::InertiaTorque { link: Some(link), factor };
                self.add(Kind::MetreMixed, &name, None, price, Change::drawn(vec![torque]));
            }
        }
        if let Inertia::Gyration(_) = mass.inertia {
            for factor in [4.0, 0.25] {
                let torque = Departure::InertiaTorque { link: Some(link), factor };
                self.add(Kind::DiameterForRadius, &name, None, PLAIN, Change::drawn(vec![torque]));
            }
        }
        let Some(centre) = self.place(mass.centre) else { return };
        let own = |acting: &&Acting| same(acting.action, Action::Inertia(link));
        let Some(acting) = sheet.bodies.iter().flat_map(|body| &body.acting).find(own) else { return };
        // The moment of the inertia force, on its line beside the mass centre, about the mass centre.
        let arm = [acting.through[0] - centre[0], acting.through[1] - centre[1]];
        let couple = arm[1] * acting.force[0] - arm[0] * acting.force[1];
        if couple == 0.0 {
            return;
        }
        let how = say!("left out of the moments of link {}", self.number(link));
        let beside = Departure::Beside { link, force: [0.0; 2], at: centre, couple };
        self.add_so((Kind::ForceLeftOut, how), &name, None, 0.5, Change::drawn(vec![beside]));
    }

    /// W for M, and M for W.
    fn weights_and_masses(&mut self) {
        let forces = &self.case.mechanism.forces;
        let (g, acts) = (forces.gravity.g.value, forces.gravity.acts);
        let masses = forces.masses.clone();
        let heavy = |weight: bool| {
            let of = masses.iter().filter(move |mass| match mass.heaviness {
                Heaviness::Weight(_) => weight,
                Heaviness::Mass(_) => !weight,
                Heaviness::None => false,
            });
            of.copied().collect::<Vec<_>>()
        };
        let mut factors = vec![g];
        let in_own_units = g / self.case.scene.units.length.si;
        if (in_own_units / g - 1.0).abs() > 1e-6 {
            factors.push(in_own_units);
        }
        for (weight, kind) in [(true, Kind::WeightAsMass), (false, Kind::MassAsWeight)] {
            let of = heavy(weight);
            let mut groups: Vec<Vec<_>> = vec![of.clone()];
            if of.len() > 1 {
                groups.extend(of.iter().map(|mass| vec![*mass]));
            }
            // M·g in the place of M, where only a mass is given.
            let weighed = if weight { None } else { Some(1.0 / g) };
            for group in groups.into_iter().filter(|group| !group.is_empty()) {
                let at = match group[..] {
                    [only] => say!("the mass of link {}", self.number(only.link)),
                    _ => say!("the masses"),
                };
                let single = if group.len() == 1 && of.len() > 1 { 0.5 } else { PLAIN };
                for (index, factor) in factors.iter().copied().chain(weighed).enumerate() {
                    let factor = if weight { factor } else { 1.0 / factor };
                    let price = single + index as f64;
                    let inertia: Vec<Departure> = group
                        .iter()
                        .flat_map(|mass| {
                            let link = Some(mass.link);
                            let force = Departure::InertiaForce { link, twist: Twist::scaled(factor) };
                            let torque = Departure::InertiaTorque { link, factor };
                            let gyration = matches!(mass.inertia, Inertia::Gyration(_));
                            [Some(force), gyration.then_some(torque)].into_iter().flatten()
                        })
                        .collect();
                    let weights: Vec<Departure> = group
                        .iter()
                        .map(|mass| Departure::Weight { link: Some(mass.link), factor })
                        .collect();
                    self.add(kind, &at, None, price, Change::drawn(inertia.clone()));
                    // The number alone: all that follows was found without it, or rightly.
                    if let [only] = group[..] {
                        let of = Quantity::Force(Force::Vector(Action::Inertia(only.link)), Share::Total);
                        let twist = Twist::scaled(factor);
                        let read = Change::read(Misreading::Twisted { of: Which::One(of), twist });
                        let name = self.name(&of);
                        self.add(kind, &name, None, price + 1.0, read);
                    }
                    // The number of a mass, W/g, drawn as a weight.
                    if acts && weight {
                        let lighter =
                            |mass: &Mass| Departure::Weight { link: Some(mass.link), factor: 1.0 / factor };
                        let lighter = group.iter().map(lighter).collect();
                        self.add(Kind::MassAsWeight, &at, None, price, Change::drawn(lighter));
                    }
                    if acts {
                        let both = [&inertia[..], &weights[..]].concat();
                        self.add(kind, &at, None, price, Change::drawn(weights));
                        self.add(kind, &at, None, price + 0.5, Change::drawn(both));
                    }
                }
            }
        }
    }

    /// Every weight forgotten, or drawn upwards.
    fn all_weights(&mut self) {
        let forces = &self.case.mechanism.forces;
        if !forces.gravity.acts || forces.masses.iter().all(|mass| mass.heaviness == Heaviness::None) {
            return;
        }
        for (kind, factor) in [(Kind::ForceLeftOut, 0.0), (Kind::SenseReversed, -1.0)] {
            let all = Departure::Weight { link: None, factor };
            self.add(kind, say!("every weight"), None, PLAIN, Change::drawn(vec![all]));
        }
    }

    /// A force of a pressure, calculated with the bore as a radius or with a unit that is off by a power of ten.
    fn loads_calculated(&mut self) {
        let loads = self.case.mechanism.forces.loads.clone();
        for (index, load) in loads.iter().enumerate() {
            if let LoadKind::Torque { .. } = load.kind {
                let name = self.force_name(Force::LoadTorque(index));
                for (kind, factor) in [(Kind::ForceLeftOut, 0.0), (Kind::MomentReversed, -1.0)] {
                    let change = Change::of_inputs(InputChange::Load { index, factor });
                    self.add(kind, &name, None, PLAIN, change);
                }
            }
            let LoadKind::Force { size: Size::Pressure { area, .. }, .. } = load.kind else { continue };
            let name = self.force_name(Force::Vector(Action::Load(index)));
            if let Area::Bore { bore, rod: Some(rod) } = area {
                let [bore, rod] = [bore.value, rod.value].map(|diameter| diameter * diameter);
                for (factor, how) in [
                    (bore / (bore - rod), say!("the rod was not taken off the area")),
                    (rod / (bore - rod), say!("the area of the rod alone")),
                ] {
                    let change = Change::of_inputs(InputChange::Load { index, factor });
                    self.add_so((Kind::LoadWrong, how), &name, None, PLAIN, change);
                }
            }
            for factor in [4.0, 0.25] {
                let change = Change::of_inputs(InputChange::Load { index, factor });
                self.add(Kind::DiameterForRadius, &name, None, PLAIN, change);
            }
            for factor in [10.0, 0.1, 100.0, 0.01, 1000.0, 0.001] {
                let change = Change::of_inputs(InputChange::Load { index, factor });
                let how = say!("a unit is off by {}", if factor > 1.0 { factor } else { 1.0 / factor });
                self.add_so((Kind::LoadWrong, how), &name, None, 0.5, change);
            }
        }
    }

    /// A load laid off at another point of its link than its own.
    fn loads_elsewhere(&mut self, sheet: &ForceSheet) {
        let standing = self.standing(sheet);
        let left_out = left_out_of_moments(standing.len());
        for Standing { link, acting, balance } in standing {
            if !matches!(acting.action, Action::Load(_)) || acting.force == [0.0; 2] {
                continue;
            }
            let points = self.case.mechanism.link(link).points.clone();
            let price = 0.5 + one_of(points.len()) / 4.0;
            let about = balance.and_then(|balance| self.place_of(balance.about));
            for point in points {
                let Some(at) = self.place(point) else { continue };
                // Where moments are taken it has none: whoever has none forgot it there more often.
                let is_about = about.is_some_and(|[x, y]| {
                    libm::hypot(at[0] - x, at[1] - y)
                        <= SAME_ARM * libm::hypot(at[0] - acting.at[0], at[1] - acting.at[1])
                });
                let price = if is_about { price.max(left_out + 0.25) } else { price };
                let [x, y] = [at[0] - acting.through[0], at[1] - acting.through[1]];
                let couple = x * acting.force[1] - y * acting.force[0];
                let arm = libm::hypot(acting.at[0] - at[0], acting.at[1] - at[1]);
                let size = libm::hypot(acting.force[0], acting.force[1]);
                // On its own line it is the same load.
                if couple.abs() <= SAME_ARM * size * arm {
                    continue;
                }
                let name = self.force_name(Force::Vector(acting.action));
                let how = say!("at {}", self.case.mechanism.point(point).name);
                let beside = Departure::Beside { link, force: [0.0; 2], at, couple };
                let change = Change::drawn(vec![beside]);
                self.add_so((Kind::LoadElsewhere, how), &name, None, price, change);
            }
        }
    }

    /// A load laid off by another angle than the stated one, and one on a straight link from its other end.
    fn loads_turned(&mut self) {
        for (index, load) in self.case.mechanism.forces.loads.clone().iter().enumerate() {
            let LoadKind::Force { pointing: Pointing::World(angle), .. } = load.kind else { continue };
            let name = self.force_name(Force::Vector(Action::Load(index)));
            let angle = angle.value;
            for (how, other) in [
                (say!("counted from the other side"), std::f64::consts::PI - angle),
                (say!("counted clockwise"), -angle),
                (say!("counted from the y axis"), FRAC_PI_2 - angle),
                (say!("counted from the y axis"), FRAC_PI_2 + angle),
                // Within its quadrant, where sine and cosine have other signs.
                (say!("sine and cosine interchanged"), -FRAC_PI_2 - angle),
            ] {
                if libm::sin((other - angle) / 2.0).abs() > SAME_ARM {
                    let change = Change::of_inputs(InputChange::LoadTurned { index, by: other - angle });
                    self.add_so((Kind::DirectionMeasured, how), &name, None, 0.25, change);
                }
            }
        }
    }

    /// M·d² added to a moment of inertia that is given about the mass centre.
    fn added_for_parallel_axes(&mut self) {
        let g = self.case.mechanism.forces.gravity.g.value;
        for mass in self.case.mechanism.forces.masses.clone() {
            let kg = match mass.heaviness {
                Heaviness::Weight(weight) => weight.value / g,
                Heaviness::Mass(mass) => mass.value,
                Heaviness::None => continue,
            };
            let central = match mass.inertia {
                Inertia::Central(inertia) => inertia.value,
                Inertia::Gyration(radius) => kg * radius.value * radius.value,
                Inertia::Point | Inertia::About(..) => continue,
            };
            let name = self.force_name(Force::InertiaTorque(mass.link));
            let Some(centre) = self.place(mass.centre) else { continue };
            for point in self.case.mechanism.link(mass.link).points.clone() {
                let Some(at) = self.place(point).filter(|_| central > 0.0) else { continue };
                let far = libm::hypot(at[0] - centre[0], at[1] - centre[1]);
                let factor = 1.0 + kg * far * far / central;
                if factor - 1.0 > SAME_ARM {
                    let torque = Departure::InertiaTorque { link: Some(mass.link), factor };
                    let point = &self.case.mechanism.point(point).name;
                    let how = say!("I about {} taken for I about the mass centre", point);
                    let change = Change::drawn(vec![torque]);
                    self.add_so((Kind::ParallelAxis, how), &name, None, PLAIN, change);
                }
            }
        }
    }

    /// A moment of inertia about another point of the link taken for that about the mass centre, or reckoned over to the
    /// wrong side.
    fn parallel_axes(&mut self) {
        self.added_for_parallel_axes();
        for mass in self.case.mechanism.forces.masses.clone() {
            let Inertia::About(about, own) = mass.inertia else { continue };
            let (Some(from), Some(centre)) = (self.place(about), self.place(mass.centre)) else { continue };
            let g = self.case.mechanism.forces.gravity.g.value;
            let kg = match mass.heaviness {
                Heaviness::Weight(weight) => weight.value / g,
                Heaviness::Mass(mass) => mass.value,
                Heaviness::None => continue,
            };
            let far = libm::hypot(from[0] - centre[0], from[1] - centre[1]);
            let central = own.value - kg * far * far;
            if central <= 0.0 || far <= 0.0 {
                continue;
            }
            let name = self.force_name(Force::InertiaTorque(mass.link));
            let point = self.case.mechanism.point(about).name.clone();
            for (factor, how) in [
                (own.value / central, say!("I about {} taken for I about the mass centre", point)),
                ((own.value + kg * far * far) / central, say!("M·d² added that is taken off")),
            ] {
                let torque = Departure::InertiaTorque { link: Some(mass.link), factor };
                let change = Change::drawn(vec![torque]);
                self.add_so((Kind::ParallelAxis, how), &name, None, PLAIN, change);
            }
        }
    }

    // --- bodies --------------------------------------------------------------------------------

    /// Every force on every body, with the moments that are taken of the body.
    fn standing<'s>(&self, sheet: &'s ForceSheet) -> Vec<Standing<'s>> {
        let mut all = Vec::new();
        for body in &sheet.bodies {
            let Party::Link(link) = body.of else { continue };
            let balance = sheet.moments.iter().find(|balance| balance.links.contains(&link));
            // What acts on links that are cut free together stands on the one that has it alone.
            let elsewhere = |acting: &&Acting| {
                let others =
                    sheet.bodies.iter().filter(|other| body.with.iter().any(|l| other.of == Party::Link(*l)));
                others.flat_map(|other| &other.acting).any(|other| other.action == acting.action)
            };
            let own = body.acting.iter().filter(|acting| !elsewhere(acting));
            all.extend(own.map(|acting| Standing { link, acting, balance }));
        }
        all
    }

    /// Where a point stands, metres from the skeleton's origin.
    fn place(&self, point: PointId) -> Option<[f64; 2]> {
        let space = &self.construction.space;
        space.places.get(point.0)?.map(|at| at.map(|mm| mm * space.metres_per_mm))
    }

    /// Where moments are taken, metres from the skeleton's origin.
    fn place_of(&self, about: About) -> Option<[f64; 2]> {
        match about {
            About::Point(point) => self.place(point),
            About::Meet { at, .. } | About::Centre { at, .. } | About::Contact { at, .. } => Some(at),
        }
    }

    /// The link of some bodies on which a couple counts in their moments.
    fn turning_link(&self, balance: &MomentBalance) -> Option<LinkId> {
        balance.links.iter().copied().find(|link| !self.case.mechanism.link(*link).block)
    }

    /// A force that somebody forgot: everywhere, in the polygon, or in the moments.
    fn left_out(&mut self, sheet: &ForceSheet) {
        let standing = self.standing(sheet);
        let price = left_out_of_moments(standing.len()) - 0.5;
        for Standing { link, acting, balance } in standing {
            let known = acting.known == crate::graphical::construction::Knowledge::Full;
            if !known || acting.force == [0.0; 2] {
                continue;
            }
            let number = self.number(link);
            let name = self.force_name(Force::Vector(acting.action));
            let at = acting.through;
            let without = acting.force.map(|part| -part);
            // What slides feels no couple in the moments that are taken of it with its rod.
            let turning = balance.and_then(|balance| self.turning_link(balance)).unwrap_or(link);
            let beside = |force: [f64; 2], couple: f64| {
                let force = Departure::Beside { link, force, at, couple: 0.0 };
                let couple = Departure::Beside { link: turning, force: [0.0; 2], at, couple };
                Change::drawn(vec![force, couple])
            };
            // Whoever takes a load in the wrong sense has it twice away from where it is.
            if matches!(acting.action, Action::Load(_)) {
                let reversed = beside(without.map(|part| 2.0 * part), 0.0);
                self.add(Kind::SenseReversed, &name, None, PLAIN, reversed);
            }
            let how = say!("left out at link {}", number);
            self.add_so((Kind::ForceLeftOut, how), &name, None, price, beside(without, 0.0));
            // An inertia force that was forgotten, and the torque of inertia that was counted for itself.
            if acting.at != at {
                let alone = [Departure::Beside { link, force: without, at: acting.at, couple: 0.0 }];
                let how = say!("left out at link {}, its couple kept", number);
                let change = Change::drawn(alone.to_vec());
                self.add_so((Kind::ForceLeftOut, how), &name, None, price + 0.25, change);
            }
            let Some(about) = balance.and_then(|balance| self.place_of(balance.about)) else { continue };
            let arm = [at[0] - about[0], at[1] - about[1]];
            let moment = arm[0] * acting.force[1] - arm[1] * acting.force[0];
            let how = say!("left out of the polygon of link {}", number);
            self.add_so((Kind::ForceLeftOut, how), &name, None, price + 0.5, beside(without, moment));
            let arm = [acting.at[0] - about[0], acting.at[1] - about[1]];
            let alone = arm[0] * acting.force[1] - arm[1] * acting.force[0];
            let how = say!("left out of the moments of link {}", number);
            self.add_so((Kind::ForceLeftOut, how), &name, None, price + 0.5, beside([0.0; 2], -moment));
            if acting.at != at {
                let how = say!("left out of the moments of link {}, its couple kept", number);
                self.add_so((Kind::ForceLeftOut, how), &name, None, price + 0.75, beside([0.0; 2], -alone));
            }
            // With the couple that shifts its line, or that counted for itself.
            for moment in [moment, alone] {
                let how = say!("in the moments of link {}", number);
                let reversed = beside([0.0; 2], -2.0 * moment);
                self.add_so((Kind::MomentReversed, how), &name, None, price, reversed);
            }
        }
    }

    /// F₂₃ where F₃₂ belongs: on the other body the force has the sense that it has on this one.
    fn handed_on_reversed(&mut self, sheet: &ForceSheet) {
        for (place, body) in sheet.bodies.iter().enumerate() {
            for acting in &body.acting {
                let Action::Pair { by, on } = acting.action else { continue };
                let later = sheet.bodies.iter().skip(place + 1).any(|other| other.of == Party::Link(by));
                if !later {
                    continue;
                }
                let name = self.force_name(Force::Vector(acting.action));
                let force = acting.force.map(|part| 2.0 * part);
                // Within a group it is found by moments already, and only the polygon has it the wrong way.
                let group = |link: LinkId| self.case.structure.group_of(link);
                let within = body.of == Party::Link(on) && group(by) == group(on);
                let balance = sheet.moments.iter().find(|balance| balance.links.contains(&by));
                let about = balance.and_then(|balance| self.place_of(balance.about)).filter(|_| within);
                let couple = about.map_or(0.0, |about| {
                    let arm = [acting.through[0] - about[0], acting.through[1] - about[1]];
                    arm[1] * force[0] - arm[0] * force[1]
                });
                let beside = Departure::Beside { link: by, force, at: acting.through, couple };
                let how = say!("with the same sense on link {}", self.number(by));
                let change = Change::drawn(vec![beside]);
                self.add_so((Kind::ReactionForAction, how), &name, None, 0.5, change);
            }
        }
    }

    /// The distance of the pin in the place of the arm.
    fn arms(&mut self, sheet: &ForceSheet) {
        for balance in &sheet.moments {
            let (Some(about), Some(link)) = (self.place_of(balance.about), self.turning_link(balance)) else {
                continue;
            };
            let pin = |of: Turning| -> Option<[f64; 2]> {
                let (Turning::Force(action) | Turning::Along(action)) = of else { return None };
                let all = sheet.bodies.iter().flat_map(|body| &body.acting);
                let found = all.into_iter().find(|acting| same(acting.action, action));
                found.map(|acting| acting.at)
            };
            for (term, found) in
                balance.terms.iter().map(|term| (term, false)).chain([(&balance.found, true)])
            {
                let (Some(pin), Some(arm)) = (pin(term.of), term.arm) else { continue };
                let (Turning::Force(action) | Turning::Along(action)) = term.of else { continue };
                let name = self.force_name(Force::Vector(action));
                // The arm on the other side of the point: of what is found the force has the other sense.
                let couple = if found { 2.0 * term.moment } else { -2.0 * term.moment };
                let beside = Departure::Beside { link, force: [0.0; 2], at: about, couple };
                let how = say!("in the moments of link {}", self.number(link));
                self.add_so((Kind::MomentReversed, how), &name, None, 0.75, Change::drawn(vec![beside]));
                let distance = libm::hypot(pin[0] - about[0], pin[1] - about[1]);
                // A force that is drawn at the point itself has no distance from it.
                let at_point = distance <= SAME_ARM * arm.length;
                if at_point || (distance - arm.length).abs() <= SAME_ARM * distance {
                    continue;
                }
                let couple = match found {
                    false => term.moment * (distance / arm.length - 1.0),
                    true => -term.moment * (arm.length / distance - 1.0),
                };
                let point = match balance.about {
                    About::Point(point) | About::Contact { pin: point, .. } => {
                        self.case.mechanism.point(point).name.as_str()
                    }
                    About::Meet { .. } => "K",
                    About::Centre { .. } => "I",
                };
                let how = say!("about {} to the pin", point);
                let beside = Departure::Beside { link, force: [0.0; 2], at: about, couple };
                self.add_so((Kind::ArmToPin, how), &name, None, 0.25, Change::drawn(vec![beside]));
            }
        }
    }

    /// Arms as they are on paper.
    fn arms_of_the_drawing(&mut self) {
        let on_paper = 1e-3 / self.case.scales.length();
        for quantity in self.observed() {
            let Quantity::Force(force, _) = quantity else { continue };
            let torque = matches!(force, Force::Torque(_) | Force::Moment(..));
            let length = matches!(force, Force::Offset(_) | Force::Arm(..));
            if !torque && !length {
                continue;
            }
            let name = self.name(&quantity);
            for (index, unit) in UNITS_OF_ARMS.into_iter().enumerate() {
                let factor = on_paper * unit;
                if (factor - 1.0).abs() < SAME_ARM || (length && index > 0) {
                    continue;
                }
                let twist = Twist::scaled(factor);
                let read = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
                self.add(Kind::ArmUnscaled, &name, None, 0.25 + index as f64 / 2.0, read.clone());
                if let Force::Offset(link) = force {
                    let followed = Change::drawn(vec![Departure::Offset { link: Some(link), factor }]);
                    self.add(Kind::ArmUnscaled, &name, None, 0.5, followed);
                }
            }
        }
        // An offset that was laid off on paper in its true length.
        for mass in self.case.mechanism.forces.masses.clone() {
            if mass.inertia != Inertia::Point && (on_paper - 1.0).abs() > SAME_ARM {
                let name = self.force_name(Force::Offset(mass.link));
                let factor = 1.0 / on_paper;
                let drawn = Departure::Offset { link: Some(mass.link), factor };
                self.add(Kind::ArmUnscaled, &name, None, 1.0, Change::drawn(vec![drawn]));
            }
        }
    }

    /// A torque on a link by a force on it and the length of some link in the place of its arm.
    fn torques(&mut self, sheet: &ForceSheet) {
        let lengths = self.lengths();
        for quantity in self.observed() {
            let Quantity::Force(Force::Torque(input), _) = quantity else { continue };
            let Some(&(Input::Angle { link, .. } | Input::Speed { link, .. })) =
                self.case.mechanism.inputs.get(input)
            else {
                continue;
            };
            let Some(right) = self.right_number(&quantity) else { continue };
            let body = sheet.bodies.iter().find(|body| body.of == Party::Link(link));
            let mut sizes: Vec<f64> = Vec::new();
            for force in body.iter().flat_map(|body| &body.acting).map(|acting| acting.force) {
                let size = libm::hypot(force[0], force[1]);
                if size > 0.0 && sizes.iter().all(|known| (known - size).abs() > SAME_ARM * size) {
                    sizes.push(size);
                }
            }
            let name = self.name(&quantity);
            let price = 0.5 + one_of(sizes.len() * lengths.len()) / 2.0;
            for (size, length) in sizes.iter().flat_map(|size| lengths.iter().map(move |l| (size, l))) {
                let factor = size * length / right.abs();
                if right == 0.0 || (factor - 1.0).abs() <= SAME_ARM {
                    continue;
                }
                let twist = Twist::scaled(factor);
                let read = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
                let how = say!("a length of {}", self.told(*length));
                self.add_so((Kind::ArmToPin, how), &name, None, price, read);
            }
        }
    }

    /// h = F/T for T/F.
    fn offsets_inverted(&mut self) {
        for mass in self.case.mechanism.forces.masses.clone() {
            let quantity = Quantity::Force(Force::Offset(mass.link), Share::Total);
            let Some(right) = self.right_number(&quantity).filter(|right| *right != 0.0) else { continue };
            let name = self.name(&quantity);
            let (unit, metre) = (self.case.scene.units.length.si, 1.0);
            let mut tried: Vec<f64> = Vec::new();
            // The number has no unit of length: it is written down as metres or in the unit of the answer.
            for (of, written) in [(metre, metre), (metre, unit), (unit, unit)] {
                let factor = of * written / (right * right);
                if tried.contains(&factor) {
                    continue;
                }
                tried.push(factor);
                let twist = Twist::scaled(factor);
                let read = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
                self.add(Kind::RatioInverted, &name, None, PLAIN, read);
                let drawn = Departure::Offset { link: Some(mass.link), factor };
                self.add(Kind::RatioInverted, &name, None, 0.25, Change::drawn(vec![drawn]));
            }
        }
    }

    /// What is right of an answer that is one number.
    fn right_number(&self, quantity: &Quantity) -> Option<f64> {
        let index = self.case.observations.iter().position(|own| own.quantity == Some(*quantity))?;
        match self.case.truth[index].as_deref() {
            Some(&[right]) => Some(right),
            _ => None,
        }
    }

    // --- guides and friction -------------------------------------------------------------------

    /// The force of a rough guide as if it were smooth, where only it is handed in so: its part square to the guide.
    fn square_parts(&mut self, sheet: &ForceSheet) {
        let mechanism = &self.case.mechanism;
        for guide in super::misread::Guideway::all(mechanism) {
            let rough = mechanism.forces.friction.slides.iter().any(|rubbing| rubbing.slide == guide.slide);
            let Party::Link(rider) = mechanism.party_of(&mechanism.slides[guide.slide].rider) else {
                continue;
            };
            let action = Action::Pair { by: LinkId::FRAME, on: rider };
            let of_pair = |of: &Quantity| match *of {
                Quantity::Force(Force::Vector(own), Share::Total) => same(own, action),
                _ => false,
            };
            let all = sheet.bodies.iter().flat_map(|body| &body.acting);
            let right = all.into_iter().find(|acting| same(acting.action, action)).map(|acting| acting.force);
            let asked = self.observed().into_iter().find(of_pair);
            let (Some([x, y]), Some(quantity), true) = (right, asked, rough) else { continue };
            let square = [-guide.along[1], guide.along[0]];
            let part = x * square[0] + y * square[1];
            let [u, v] = square.map(|of| of * part);
            let turn = libm::atan2(x * v - y * u, x * u + y * v);
            let twist = Twist { factor: part.abs() / libm::hypot(x, y), turn };
            if twist.factor.is_finite() && twist.factor > 0.0 {
                let name = self.name(&quantity);
                let read = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
                self.add(Kind::FrictionLeftOut, &name, None, 0.25, read);
            }
        }
    }

    /// The force of a guide along another line than square to it.
    fn guides(&mut self, sheet: &ForceSheet) {
        let mechanism = &self.case.mechanism;
        let mut lines: Vec<(f64, Phrase)> = vec![(FRAC_PI_2, say!("vertical")), (0.0, say!("horizontal"))];
        for link in mechanism.moving() {
            if let [a, b, ..] = mechanism.link(link).points[..]
                && let (Some(from), Some(to)) = (self.place(a), self.place(b))
            {
                let angle = libm::atan2(to[1] - from[1], to[0] - from[0]);
                let number = mechanism.link(link).number;
                lines.push((angle, say!("along link {}", number)));
                lines.push((angle + FRAC_PI_2, say!("square to link {}", number)));
            }
        }
        let price = 0.5 + one_of(lines.len()) / 2.0;
        for (slide, Slide { rider, guide }) in mechanism.slides.clone().into_iter().enumerate() {
            // A guide that rubs does not press square to itself.
            if mechanism.forces.friction.slides.iter().any(|rubbing| rubbing.slide == slide) {
                continue;
            }
            let Party::Link(rider) = mechanism.party_of(&rider) else { continue };
            let action = Action::Pair { by: guide.link, on: rider };
            let all = sheet.bodies.iter().flat_map(|body| &body.acting);
            let Some(right) = all.into_iter().find(|acting| same(acting.action, action)) else { continue };
            let name = self.force_name(Force::Vector(action));
            for (along, how) in &lines {
                let direction = [libm::cos(*along), libm::sin(*along)];
                let size = libm::hypot(right.force[0], right.force[1]);
                if size > 0.0 && apart(direction, right.force.map(|part| part / size)) {
                    let drawn = Departure::GuideForce { slide, along: *along };
                    let change = Change::drawn(vec![drawn]);
                    self.add_so((Kind::GuideForceNotSquare, how.clone()), &name, None, price, change);
                }
            }
        }
    }

    fn friction(&mut self) {
        let friction = self.case.mechanism.forces.friction.clone();
        let circles: Vec<Departure> = friction
            .pins
            .iter()
            .filter_map(|rubbing| match rubbing.circle {
                FrictionCircle::Journal { roughness, .. } => {
                    let factor = 1.0 / libm::sin(roughness.angle());
                    Some(Departure::FrictionCircle { pin: rubbing.pin, factor })
                }
                FrictionCircle::Radius(_) => None,
            })
            .collect();
        let tangents: Vec<Departure> = friction
            .pins
            .iter()
            .map(|rubbing| Departure::FrictionCircle { pin: rubbing.pin, factor: -1.0 })
            .collect();
        let name = |departure: &Departure| match *departure {
            Departure::FrictionCircle { pin, .. } => {
                say!("the friction circle at {}", self.case.mechanism.point(pin).name)
            }
            _ => Phrase::from(""),
        };
        let mut found: Vec<(Kind, Phrase, f64, Vec<Departure>)> = Vec::new();
        let smooth_pins: Vec<Departure> = friction
            .pins
            .iter()
            .map(|rubbing| Departure::FrictionCircle { pin: rubbing.pin, factor: 0.0 })
            .collect();
        let slides = self.case.mechanism.rubbing_pairs().into_iter().filter_map(|pair| match pair {
            RubbingPair::Slide(slide) => Some(Departure::FrictionAngle { slide, factor: 0.0 }),
            _ => None,
        });
        let smooth_guides: Vec<Departure> = slides.collect();
        let smooth = [&smooth_pins[..], &smooth_guides[..]].concat();
        let both = !smooth_pins.is_empty() && !smooth_guides.is_empty();
        for (at, departures, among) in [
            (say!("every pair"), smooth, both),
            (say!("the pins"), smooth_pins, true),
            (say!("the guides"), smooth_guides, true),
        ] {
            if among && !departures.is_empty() {
                found.push((Kind::FrictionLeftOut, at, PLAIN, departures));
            }
        }
        for (kind, departures) in [(Kind::CircleIsJournal, circles), (Kind::OtherTangent, tangents)] {
            let single = if departures.len() > 1 { 0.5 } else { PLAIN };
            for departure in &departures {
                found.push((kind, name(departure), single, vec![*departure]));
            }
            if departures.len() > 1 {
                found.push((kind, say!("every friction circle"), PLAIN, departures));
            }
        }
        let journals =
            friction.pins.iter().filter(|rubbing| matches!(rubbing.circle, FrictionCircle::Journal { .. }));
        for pin in journals.map(|rubbing| rubbing.pin) {
            for factor in [2.0, 0.5] {
                let other = Departure::FrictionCircle { pin, factor };
                found.push((Kind::DiameterForRadius, name(&other), 0.25, vec![other]));
            }
        }
        for pair in self.case.mechanism.rubbing_pairs() {
            let RubbingPair::Slide(slide) = pair else { continue };
            let Some(point) = self.case.mechanism.pin_of_slide(slide) else { continue };
            let at = say!("the guide of {}", self.case.mechanism.point(point).name);
            let back = Departure::FrictionAngle { slide, factor: -1.0 };
            found.push((Kind::FrictionAngleReversed, at.clone(), PLAIN, vec![back]));
            for factor in [2.0, 0.5] {
                let other = Departure::FrictionAngle { slide, factor };
                found.push((Kind::FrictionMisread, at.clone(), 0.5, vec![other]));
            }
            self.any_coefficient(slide, &at);
        }
        for (kind, at, price, departures) in found {
            self.add(kind, &at, None, price, Change::drawn(departures));
        }
    }

    /// The coefficient of friction of a guide of the frame that the force across it tells, as it was handed in.
    fn any_coefficient(&mut self, slide: usize, at: &Phrase) {
        let mechanism = &self.case.mechanism;
        let Some(guide) = Guideway::all(mechanism).into_iter().find(|guide| guide.slide == slide) else {
            return;
        };
        let rubbing = mechanism.forces.friction.slides.iter().find(|rubbing| rubbing.slide == slide);
        let Some(Resistance::Friction(Roughness::Coefficient(right))) = rubbing.map(|one| one.resistance)
        else {
            return;
        };
        let block = match mechanism.slides[slide].rider {
            Rider::Pin { block, .. } => block,
            Rider::Link { link, .. } => Some(link),
        };
        // Along the guide over across it, with a sign: the tangent by which a force leans.
        let leaning = |[x, y]: [f64; 2]| {
            let [u, v] = guide.along;
            (x * u + y * v) / (y * u - x * v)
        };
        let told = self.case.observations.iter().enumerate().find_map(|(index, observation)| {
            let Some(Quantity::Force(Force::Vector(Action::Pair { by, on }), Share::Total)) =
                observation.quantity
            else {
                return None;
            };
            let of_guide =
                [by, on].contains(&LinkId::FRAME) && block.is_some_and(|block| [by, on].contains(&block));
            let (&[x, y], Given::Vector(own)) = (self.case.truth[index].as_deref()?, observation.given)
            else {
                return None;
            };
            let factor = leaning(own) / leaning([x, y]);
            (of_guide && factor.is_finite() && factor > 0.0).then_some(factor)
        });
        let Some(factor) = told else { return };
        let own = factor * right.value;
        // It is written with few digits; one that is as near as the angle can be measured is the given one.
        let [own_told, told] = [own, right.value].map(|number| super::text::digits(number, 0.01));
        if own_told == told || own > MOST_FRICTION {
            return;
        }
        let other = Departure::FrictionAngle { slide, factor };
        let how = (Kind::FrictionMisread, say!("{} for {}", own_told, told));
        self.add_so(how, at, None, FOUND, Change::drawn(vec![other]));
    }

    // --- the whole -----------------------------------------------------------------------------

    fn shares(&mut self) {
        let forces = &self.case.mechanism.forces;
        let besides_weights = !forces.loads.is_empty() || !forces.springs.is_empty();
        let at_rest = besides_weights || forces.gravity.acts;
        if forces.masses.is_empty() || !at_rest {
            return;
        }
        let only = |share| Change::drawn(vec![Departure::OnlyShare(share)]);
        // Weights alone have a name of their own.
        if besides_weights {
            self.add(Kind::StaticLeftOut, say!("the whole"), None, PLAIN, only(Share::Inertia));
        }
        self.add(Kind::InertiaLeftOut, say!("the whole"), None, 0.5, only(Share::Static));
    }

    /// F_S with what acts from outside.
    fn shaking(&mut self, sheet: &ForceSheet) {
        let shaking = Quantity::Force(Force::Vector(Action::Shaking), Share::Total);
        if !self.observed().contains(&shaking) {
            return;
        }
        let mut given: Vec<&Acting> = Vec::new();
        for acting in sheet.bodies.iter().flat_map(|body| &body.acting) {
            if given.iter().all(|other| other.action != acting.action) {
                given.push(acting);
            }
        }
        let sum = |wanted: &dyn Fn(Action) -> bool| {
            let of = given.iter().filter(|acting| wanted(acting.action));
            of.fold([0.0, 0.0], |[x, y], acting| [x + acting.force[0], y + acting.force[1]])
        };
        let is_load = |action: Action| matches!(action, Action::Load(_));
        let is_weight = |action: Action| matches!(action, Action::Weight(_));
        let name = self.name(&shaking);
        let sums = [sum(&is_load), sum(&|action| is_load(action) || is_weight(action)), sum(&is_weight)];
        let mut tried: Vec<[f64; 2]> = vec![[0.0; 2]];
        for by in sums {
            if !tried.contains(&by) {
                tried.push(by);
                let read = Change::read(Misreading::Plus { of: shaking, by });
                self.add(Kind::LoadsInShaking, &name, None, PLAIN, read);
            }
        }
    }

    // --- the turning-moment diagram ------------------------------------------------------------

    /// Every area of the diagram with its angles in degrees, and the numbers that are reckoned from areas.
    fn areas_of_diagram(&mut self) {
        let all: Vec<Quantity> = self
            .observed()
            .into_iter()
            .filter(|quantity| matches!(quantity, Quantity::Cycle(of) if is_energy(*of)))
            .collect();
        let scaled = |of: &[Quantity], factor: f64| {
            let twist = Twist::scaled(factor);
            let readings = of.iter().map(|&of| Misreading::Twisted { of: Which::One(of), twist });
            Change { readings: readings.collect(), ..Change::default() }
        };
        let degrees = 180.0 / std::f64::consts::PI;
        let mut ways = vec![(Kind::DegAsRad, None, degrees)];
        if let Some(Sides::Areas { torque, angle, .. }) =
            self.case.mechanism.forces.cycle.as_ref().map(|cycle| &cycle.sides)
        {
            ways.extend([
                (Kind::ScaleForgotten, Some(say!("the scale of angles was left out")), 1.0 / angle.value),
                (Kind::ScaleForgotten, Some(say!("the scale of torques was left out")), 1.0 / torque.value),
                (
                    Kind::ScaleForgotten,
                    Some(say!("the scale of torques was left out")),
                    degrees / torque.value,
                ),
                (
                    Kind::ScaleForgotten,
                    Some(say!("the scale of torques and angles was left out")),
                    1.0 / (torque.value * angle.value),
                ),
            ]);
        }
        let mean = |of: &Quantity| {
            matches!(of, Quantity::Cycle(CycleQuantity::Mean | CycleQuantity::Power | CycleQuantity::Work))
        };
        let levels: Vec<Quantity> = all.iter().copied().filter(|of| !mean(of)).collect();
        for group in [&all, &levels] {
            for (kind, how, factor) in ways.iter().filter(|_| !group.is_empty()) {
                let at = say!("the areas of the diagram");
                let change = scaled(group, *factor);
                let (kind, how, step) = (*kind, how.clone(), None);
                self.found.push(Hypothesis { kind, at, step, price: PLAIN, change, how });
            }
        }
    }

    /// A negative value of the table taken as positive, and the mean of the values in the place of that of the curve.
    fn knots_of_diagram(&mut self) {
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return };
        let (Sides::Torque(Course::Curve(curve)) | Sides::Load(Course::Curve(curve))) = &cycle.sides else {
            return;
        };
        let Curve::Table { knots, .. } = curve.clone() else { return };
        let unit = &self.case.scene.units.torque;
        for (index, [at, torque]) in knots.iter().enumerate() {
            if torque.value < 0.0 {
                let read = |value: f64| super::misread::written(value / unit.si);
                let how = say!(
                    "{} read as {} {} at {}°",
                    read(torque.value),
                    read(-torque.value),
                    unit.symbol,
                    super::misread::written(at.value.to_degrees())
                );
                let change = Change::of_inputs(InputChange::Knot { index, factor: -1.0 });
                self.add_so((Kind::LoadWrong, how), say!("the diagram"), None, PLAIN, change);
            }
        }
        // A table that ends where it begins tells its first value twice: some leave one out.
        let mean = self.case.right_number(Quantity::Cycle(CycleQuantity::Mean));
        let Some(mean) = mean.filter(|mean| *mean != 0.0) else { return };
        for leave in 0..2.min(knots.len()) {
            let counted = &knots[leave..];
            let sum: f64 = counted.iter().map(|[_, torque]| torque.value).sum();
            #[expect(clippy::cast_precision_loss, reason = "knots are few")]
            let average = sum / counted.len() as f64;
            let readings = [CycleQuantity::Mean, CycleQuantity::Power].map(|of| Misreading::Twisted {
                of: Which::One(Quantity::Cycle(of)),
                twist: Twist::scaled(average / mean),
            });
            let how = (Kind::WrongFormula, say!("the mean of the values, not of the area"));
            let name = self.name(&Quantity::Cycle(CycleQuantity::Mean));
            let read = Change { readings: readings.to_vec(), ..Change::default() };
            self.add_so(how, &name, None, 0.5, read);
        }
    }

    /// Numbers of the diagram by another formula than their own.
    fn reckoned_otherwise(&mut self) {
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return };
        let (period, there) = (cycle.period.value, self.case.rotating);
        let right = |of: CycleQuantity| self.case.right_number(Quantity::Cycle(of));
        let twisted = |of: CycleQuantity, factor: f64| {
            let twist = Twist::scaled(factor);
            Change::read(Misreading::Twisted { of: Which::One(Quantity::Cycle(of)), twist })
        };
        let plus = |of: CycleQuantity, by: f64| {
            Change::read(Misreading::Plus { of: Quantity::Cycle(of), by: [by, 0.0] })
        };
        let mut ways = vec![(CycleQuantity::OfEnergy, say!("E_f/T_m in the place of E_f/E"), {
            twisted(CycleQuantity::OfEnergy, period)
        })];
        if there > 0.0 {
            let flywheel = CycleQuantity::Flywheel;
            ways.push((flywheel, say!("what turns already was not taken off"), plus(flywheel, there)));
            ways.push((flywheel, say!("what turns already was added"), plus(flywheel, 2.0 * there)));
        }
        let levels = [CycleQuantity::Fluctuation, CycleQuantity::Highest, CycleQuantity::Lowest].map(right);
        if let [Some(fluctuation), Some(highest), Some(lowest)] = levels
            && fluctuation > 0.0
        {
            for (level, how) in [
                (highest, say!("the highest level alone")),
                (lowest.abs(), say!("the lowest level alone")),
                ((highest + lowest).abs(), say!("the lowest level with the wrong sign")),
            ] {
                let factor = level / fluctuation;
                if factor > 0.0 && (factor - 1.0).abs() > 1e-3 {
                    let taken = Change::read(Misreading::Fluctuation { factor, inertia: there });
                    ways.push((CycleQuantity::Fluctuation, how, taken));
                }
            }
        }
        for (of, how, change) in ways {
            let name = self.name(&Quantity::Cycle(of));
            self.add_so((Kind::WrongFormula, how), &name, None, PLAIN, change);
        }
    }

    /// The inertia of what turns with a weight for its mass or a diameter for its radius, and ω for ω² in what is reckoned
    /// from it.
    fn what_turns(&mut self) {
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return };
        let (rotating, omega) = (cycle.rotating.clone(), cycle.omega.value.abs());
        let g = self.case.mechanism.forces.gravity.g.value;
        let inertia = self.name(&Quantity::Cycle(CycleQuantity::Inertia));
        for (index, one) in rotating.iter().enumerate() {
            let mut ways: Vec<(Kind, f64)> = Vec::new();
            match one.inertia {
                RotatingInertia::Central(_) => {}
                RotatingInertia::Mass(..) => ways.push((Kind::MassAsWeight, 1.0 / g)),
                RotatingInertia::Weight(..) => ways.push((Kind::WeightAsMass, g)),
            }
            if !matches!(one.inertia, RotatingInertia::Central(_)) {
                ways.extend([(Kind::DiameterForRadius, 4.0), (Kind::DiameterForRadius, 0.25)]);
            }
            for (kind, factor) in ways {
                let change = Change::of_inputs(InputChange::Rotating { index, factor });
                self.add(kind, &inertia, None, PLAIN, change);
            }
            let (kg, radius) = match one.inertia {
                RotatingInertia::Central(_) => continue,
                RotatingInertia::Mass(mass, radius) => (mass.value, radius.value),
                RotatingInertia::Weight(weight, radius) => (weight.value / g, radius.value),
            };
            // With it what turns may be heavy enough already, and the flywheel lighter than nothing.
            let ratio = one.ratio.value * one.ratio.value;
            let (right, more) = (self.case.rotating, kg * ratio * (radius - radius * radius));
            if right > 0.0 && more != 0.0 {
                let twisted = |of: CycleQuantity, factor: f64| Misreading::Twisted {
                    of: Which::One(Quantity::Cycle(of)),
                    twist: Twist::scaled(factor),
                };
                let readings = vec![
                    twisted(CycleQuantity::Inertia, (right + more) / right),
                    twisted(CycleQuantity::OfSpeed, right / (right + more)),
                    Misreading::Plus { of: Quantity::Cycle(CycleQuantity::Flywheel), by: [-more, 0.0] },
                ];
                let how = (Kind::WrongFormula, say!("M·k in the place of M·k²"));
                self.add_so(how, &inertia, None, PLAIN, Change { readings, ..Change::default() });
            }
        }
        for of in [CycleQuantity::OfSpeed, CycleQuantity::Flywheel].map(Quantity::Cycle) {
            if omega > 0.0 && self.observed().contains(&of) {
                let name = self.name(&of);
                // So that its square is ω.
                let root = 1.0 / omega.sqrt();
                let read = Change::read(Misreading::RateIn { of, omega: root });
                self.add(Kind::RateNotSquared, &name, None, PLAIN, read);
            }
        }
    }

    pub(super) fn turning_moments(&mut self) {
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return };
        let turn = 2.0 * std::f64::consts::PI;
        let period = cycle.period.value;
        let areas = matches!(cycle.sides, Sides::Areas { .. });
        if (period / turn - 1.0).abs() > 1e-9 && (period / turn - 2.0).abs() > 1e-9 {
            // A period that is a part of a turn taken for a whole one.
            let means = [CycleQuantity::Mean, CycleQuantity::Power].map(|of| Misreading::Twisted {
                of: Which::One(Quantity::Cycle(of)),
                twist: Twist::scaled(period / turn),
            });
            let read = Change { readings: means.to_vec(), ..Change::default() };
            self.add_so((Kind::OneTurnForTwo, say!("a whole turn")), say!("the period"), None, PLAIN, read);
        }
        // The whole diagram over half of its turns, or a mean alone over another number of turns.
        let mean_over = |factor: f64| {
            let means = [CycleQuantity::Mean, CycleQuantity::Power].map(|of| Misreading::Twisted {
                of: Which::One(Quantity::Cycle(of)),
                twist: Twist::scaled(factor),
            });
            Change { readings: means.to_vec(), ..Change::default() }
        };
        let at = say!("the period");
        if (period / turn - 2.0).abs() < 1e-9 {
            self.add(Kind::OneTurnForTwo, &at, None, PLAIN, Change::of_inputs(InputChange::Period(0.5)));
            self.add(Kind::OneTurnForTwo, at, None, 0.5, mean_over(2.0));
        } else if (period / turn - 1.0).abs() < 1e-9 {
            self.add(Kind::OneTurnForTwo, &at, None, PLAIN, mean_over(0.5));
            self.add_so((Kind::OneTurnForTwo, say!("half a turn")), at, None, 0.5, mean_over(2.0));
        }
        self.knots_of_diagram();
        self.reckoned_otherwise();
        self.areas_of_diagram();
        self.what_turns();
        let Some(cycle) = &self.case.mechanism.forces.cycle else { return };
        if cycle.fluctuation.is_some() {
            let change = |factor: f64| Change::of_inputs(InputChange::Fluctuation(factor));
            self.add(Kind::HalfFluctuation, "Ks", None, PLAIN, change(0.5));
            let doubled = (Kind::HalfFluctuation, say!("the whole range taken for it and doubled"));
            self.add_so(doubled, "Ks", None, PLAIN, change(2.0));
        }
        let of_speed = Quantity::Cycle(CycleQuantity::OfSpeed);
        if self.observed().contains(&of_speed) {
            let twist = Twist::scaled(0.5);
            let read = Change::read(Misreading::Twisted { of: Which::One(of_speed), twist });
            self.add(Kind::HalfFluctuation, "Ks", None, PLAIN, read);
        }
        if let Some(sheet) = &self.case.cycle {
            let largest = sheet.areas.iter().map(|area| area.abs()).fold(0.0, f64::max);
            let level = |index: usize| sheet.levels.get(index).copied();
            let highest = sheet.extremes.and_then(|[high, low]| Some(level(high)? - level(low)?));
            if let Some(fluctuation) = highest.filter(|ef| *ef > 0.0 && largest > 0.0) {
                let factor = largest / fluctuation;
                if (factor - 1.0).abs() > 1e-3 {
                    let taken = Misreading::Fluctuation { factor, inertia: self.case.rotating };
                    let price = if areas { PLAIN } else { 0.25 };
                    self.add(Kind::LargestArea, "Ef", None, price, Change::read(taken));
                }
            }
        }
    }
}

/// What it costs that one of so many forces was left out of moments.
fn left_out_of_moments(forces: usize) -> f64 {
    1.0 + one_of(forces) / 4.0
}

/// Whether a number of a turning-moment diagram is an area of it, or a part of one.
fn is_energy(of: CycleQuantity) -> bool {
    !of.is_angle()
        && matches!(
            of,
            CycleQuantity::Work
                | CycleQuantity::Mean
                | CycleQuantity::Power
                | CycleQuantity::Area(_)
                | CycleQuantity::Level(_)
                | CycleQuantity::Highest
                | CycleQuantity::Lowest
                | CycleQuantity::Fluctuation
                | CycleQuantity::OfSpeed
        )
}

/// Whether two actions are one force, or a force and its reaction.
pub(super) fn same(one: Action, other: Action) -> bool {
    let key = |action: Action| match action {
        Action::Pair { by, on } => Action::Pair { by: by.min(on), on: by.max(on) },
        Action::OnPin(link, pin) => Action::OfPin(pin, link),
        Action::Spring { index, .. } => Action::Spring { index, end: 0 },
        other => other,
    };
    key(one) == key(other)
}
