//! Every typical mistake that can be made in a construction, as what it changes.

use std::f64::consts::{FRAC_PI_2, PI};

use super::case::{Case, Target, claimed, direction, polygon, size};
use super::change::{Change, InRadians, InputChange, Misreading, Stray, Which};
use super::kind::Kind;
use super::phrase::{Phrase, say};
use crate::graphical::construction::{Act, Calculation, Claim, Construction, Label, Reference, Vector};
use crate::graphical::{Departure, Sketch, Twist};
use crate::mechanism::force::{Action, Force};
use crate::mechanism::quantity::{DiagramKind, Order, Quantity};
use crate::mechanism::{Form, Input, LinkId, PointId, Rider};
use crate::plan::DiagramPlan;

/// A mistake that may have been made.
#[derive(Debug, Clone)]
pub(super) struct Hypothesis {
    pub(super) kind: Kind,
    /// What it is about: a quantity or a link, or nothing for what is given.
    pub(super) at: Phrase,
    /// The number of the step, from 1, in which it is made, where there is one.
    pub(super) step: Option<usize>,
    /// How far-fetched it is, as the squares of misses are counted.
    pub(super) price: f64,
    pub(super) change: Change,
    /// What exactly was done, in a clause, where kind and place do not say it.
    pub(super) how: Option<Phrase>,
}

/// A slip that is made as a whole, in the way that the textbook warns of.
pub(super) const PLAIN: f64 = 0.0;
/// A less usual form of it.
const UNUSUAL: f64 = 2.0;
/// A mistake of the motion that only forces could show, or one in a polygon of which nothing is handed in.
const UNSEEN: f64 = 1.0;
/// A far-fetched form.
const FAR: f64 = 4.0;
/// A unit that explains why numbers are a tenth is likelier than a scale that would.
const BESIDE_A_UNIT: f64 = -0.25;
/// A fault that further points of the link have by its image, where the solution calculates these anew.
const BY_IMAGE: f64 = 0.1;

/// What may be wrong with a construction, as it stands after `so_far`.
pub(super) fn all(case: &Case<'_>, so_far: &Sketch, drawn: &Change) -> Vec<Hypothesis> {
    let mut list = List { case, construction: &so_far.construction, normals: Vec::new(), found: Vec::new() };
    list.normals = list.normal_parts();
    list.given();
    list.assemblies();
    list.laid_off();
    list.lengths_halved();
    list.rays();
    list.rates();
    list.images();
    list.stray_lines();
    list.readings();
    list.scales();
    list.wrong_scales();
    list.figures_turned();
    list.poles(so_far);
    list.units();
    list.calculator();
    list.skeleton();
    list.written_otherwise();
    list.interchanged();
    list.rates_by_wrong_distances();
    list.ratios_of_distances();
    list.slip_with_coriolis();
    list.slip_forgotten();
    list.rolling();
    list.directions();
    list.degrees();
    list.centres(so_far);
    // Nor does anybody who answered nothing of the velocities show where their polygon went wrong.
    if !case.answers(Order::Velocity) && case.answers(Order::Acceleration) {
        let unseen = |one: &&mut Hypothesis| one.change.departs_in(Order::Velocity);
        list.found.iter_mut().filter(unseen).for_each(|one| one.price += UNSEEN);
    }
    // Nor in which sense the input turns.
    if !case.answers(Order::Velocity) {
        let input = say!("the input");
        let turned = |one: &&mut Hypothesis| one.kind == Kind::SenseReversed && one.at == input;
        list.found.iter_mut().filter(turned).for_each(|one| one.price += UNUSUAL);
    }
    if let Some(sheet) = case.bodies(drawn) {
        // Nobody who answered nothing of the motion shows where its polygons went wrong, nor by which scale he read them: any
        // number is met by a factor somewhere.
        if ![Order::Velocity, Order::Acceleration].into_iter().any(|order| case.answers(order)) {
            list.found.retain(|one| !(one.kind.is_of_scale() && one.change.redraws()));
            list.found.iter_mut().filter(|one| one.change.redraws()).for_each(|one| one.price += UNSEEN);
        }
        list.forces(&sheet);
    }
    list.turning_moments();
    list.found
}

pub(super) struct List<'c, 's> {
    pub(super) case: &'c Case<'s>,
    pub(super) construction: &'c Construction,
    /// The normal parts that are calculated, each with its link.
    normals: Vec<(Quantity, LinkId)>,
    pub(super) found: Vec<Hypothesis>,
}

/// A link as its own calculation knows it.
#[derive(Clone, Copy)]
struct Turning {
    link: LinkId,
    omega: f64,
    length: f64,
    /// From the base to the point, radians.
    angle: f64,
}

/// How answers were misread, by which they are.
type Reading<'r> = &'r dyn Fn(Which) -> Misreading;

impl<'c> List<'c, '_> {
    pub(super) fn add(
        &mut self,
        kind: Kind,
        at: impl Into<Phrase>,
        step: Option<usize>,
        price: f64,
        change: Change,
    ) {
        self.found.push(Hypothesis { kind, at: at.into(), step, price, change, how: None });
    }

    /// The same, with what exactly was done.
    pub(super) fn add_so(
        &mut self,
        (kind, how): (Kind, Phrase),
        at: impl Into<Phrase>,
        step: Option<usize>,
        price: f64,
        change: Change,
    ) {
        self.found.push(Hypothesis { kind, at: at.into(), step, price, change, how: Some(how) });
    }

    pub(super) fn name(&self, quantity: &Quantity) -> String {
        self.case.named(quantity)
    }

    pub(super) fn number(&self, link: LinkId) -> u32 {
        self.case.mechanism.link(link).number
    }

    // --- what was given ------------------------------------------------------------------------

    fn given(&mut self) {
        let inputs = &self.case.mechanism.inputs;
        let seconds = inputs.iter().any(|input| match input {
            Input::Angle { alpha, .. } | Input::Speed { alpha, .. } => alpha.value != 0.0,
            Input::Slide { acceleration, .. } => acceleration.value != 0.0,
        });
        let rates = |omega: f64, alpha: f64| Change::of_inputs(InputChange::Rates { omega, alpha });
        self.add(Kind::SenseReversed, say!("the input"), None, PLAIN, rates(-1.0, 1.0));
        if seconds {
            self.add(Kind::SenseReversed, say!("the input"), None, UNUSUAL, rates(-1.0, -1.0));
            self.add(Kind::AlphaIgnored, say!("the input"), None, PLAIN, rates(1.0, 0.0));
            self.add(Kind::AlphaSign, say!("the input"), None, PLAIN, rates(1.0, -1.0));
        }
        for units in &self.case.scene.input_units {
            let Some(rate) = &units.rate else { continue };
            let (turn, degrees) = (2.0 * PI, 180.0 / PI);
            let mixed: &[(Kind, f64, f64)] = if rate.symbol == "rpm" || rate.symbol.ends_with("/min") {
                // Turned into revolutions per second only, or only by 2π.
                &[
                    (Kind::RpmAsRad, 1.0 / rate.si, PLAIN),
                    (Kind::RevAsRad, 1.0 / turn, PLAIN),
                    (Kind::RpmAsRad, 60.0, UNUSUAL),
                    (Kind::DegAsRad, degrees, 1.0),
                ]
            } else if rate.symbol.starts_with("rev") {
                &[(Kind::RevAsRad, 1.0 / turn, PLAIN), (Kind::DegAsRad, degrees, 1.0)]
            } else if rate.symbol.starts_with("deg") {
                &[(Kind::DegAsRad, degrees, PLAIN)]
            } else if rate.symbol.starts_with("rad") {
                // Taken for rpm and converted, or converted into rpm and used.
                &[
                    (Kind::RadAsRpm, turn / 60.0, PLAIN),
                    (Kind::RadAsRpm, 60.0 / turn, PLAIN),
                    (Kind::RevAsRad, turn, UNUSUAL),
                ]
            } else {
                &[]
            };
            for &(kind, omega, price) in mixed {
                self.add(kind, say!("the input"), None, price, rates(omega, 1.0));
                // In one number of the turning-moment diagram alone: the others hang on no rate, or are right.
                for of in self.observed() {
                    if matches!(of, Quantity::Cycle(_)) {
                        let name = self.name(&of);
                        let read = Change::read(Misreading::RateIn { of, omega });
                        self.add(kind, &name, None, price + 0.5, read);
                    }
                }
            }
        }
        // The answers in another unit than they say.
        let omegas: Vec<Quantity> =
            self.observed().into_iter().filter(|of| Which::Omegas.includes(of)).collect();
        // The number of radians per second, and the other unit beside it.
        let in_turns: Vec<Quantity> =
            omegas.iter().copied().filter(|of| self.case.is_in_turns_a_minute(of)).collect();
        for (kind, factor, among) in [
            (Kind::RadAsRpm, 30.0 / PI, &omegas),
            (Kind::RevAsRad, 0.5 / PI, &omegas),
            (Kind::RadAsRpm, PI / 30.0, &in_turns),
        ] {
            let twisted = |of| Change::read(Misreading::Twisted { of, twist: Twist::scaled(factor) });
            if among.len() == omegas.len() {
                self.add(kind, say!("the answers"), None, UNUSUAL, twisted(Which::Omegas));
            }
            for quantity in among {
                let name = self.name(quantity);
                self.add(kind, &name, None, UNUSUAL + 1.0, twisted(Which::One(*quantity)));
            }
        }
    }

    /// A calculator that computes in radians: of the given angle, or of every direction that is written down.
    fn calculator(&mut self) {
        let kind = Kind::CalculatorInRadians;
        // As it was written: 200°, not −160°.
        let angles: Vec<(usize, f64, f64)> = self.angles().collect();
        let typed = angles
            .iter()
            .map(|&(input, stated, _)| InputChange::Angle { input, by: stated.to_degrees() - stated });
        let given = Change { inputs: typed.collect(), ..Change::default() };
        if !given.inputs.is_empty() {
            self.add(kind, say!("the given angle"), None, PLAIN, given);
        }
        let ways = [true, false]
            .into_iter()
            .flat_map(|typed| [false, true].into_iter().map(move |from_zero| InRadians { typed, from_zero }));
        for how in ways {
            let spoilt = |of| Change::read(Misreading::InRadians { of, how });
            self.add(kind, say!("the directions"), None, 1.0, spoilt(Which::AllVectors));
            for (order, at) in
                [(Order::Velocity, say!("the velocities")), (Order::Acceleration, say!("the accelerations"))]
            {
                self.add(kind, at, None, UNUSUAL, spoilt(Which::Vectors(order)));
            }
            for quantity in self.observed() {
                if super::answers::is_vector(&quantity) {
                    let name = self.name(&quantity);
                    self.add(kind, &name, None, FAR, spoilt(Which::One(quantity)));
                }
            }
        }
    }

    /// The given angles of inputs as they are written, by the index of the input, and as the mechanism has them.
    fn angles(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let inputs = self.case.mechanism.inputs.iter().zip(&self.case.scene.input_units).enumerate();
        inputs.filter_map(|(index, (input, units))| match input {
            Input::Angle { angle: Some(angle), .. } | Input::Speed { angle: Some(angle), .. } => {
                Some((index, units.angle?, angle.value))
            }
            _ => None,
        })
    }

    /// The input laid off from the other side, or with a point or a length of the skeleton that is handed in wrongly.
    fn skeleton(&mut self) {
        let angles: Vec<(usize, f64, f64)> = self.angles().collect();
        for (input, _, angle) in angles {
            let ways = [
                (say!("counted from the other side"), PLAIN, PI - angle),
                (say!("counted clockwise"), 0.5, -angle),
                (say!("counted from the y axis"), 1.0, FRAC_PI_2 - angle),
            ];
            for (how, price, other) in ways {
                let change = Change::of_inputs(InputChange::Angle { input, by: other - angle });
                let kind = (Kind::InputAngle, how);
                self.add_so(kind, say!("the input"), None, price, change);
            }
        }
        for (point, at) in self.case.misplaced() {
            self.drawn_at_another_angle(point, at);
            self.drawn_too_long(point, at);
            self.drawn_on_another_guide(point, at);
            self.drawn_elsewhere_on_its_link(point, at);
        }
        for (slide, how, change) in super::misread::offsets(self.case) {
            let at = super::misread::rider(&self.case.mechanism, slide);
            self.add_so((Kind::GuideMisplaced, how), &at, None, PLAIN, Change::of_inputs(change));
        }
        for (point, how, change) in super::misread::third_points(self.case) {
            let at = self.case.mechanism.point(point).name.clone();
            self.add_so((Kind::PointLaidOff, how), &at, None, 1.0, Change::of_inputs(change));
        }
        for &(point, by) in &self.case.pivots {
            let name = self.case.mechanism.point(point).name.clone();
            let change = Change::of_inputs(InputChange::Pivot { point, by });
            self.add(Kind::PivotMisplaced, &name, None, PLAIN, change);
        }
    }

    /// Two answers of one kind handed in for each other.
    fn interchanged(&mut self) {
        let observed = self.observed();
        // Points and numbers of one kind, any two vectors of one polygon, any two forces at pairs.
        let like = |one: &Quantity, other: &Quantity| {
            let plain = |quantity: &Quantity| {
                matches!(quantity, Quantity::Centre(..) | Quantity::Omega(_) | Quantity::Alpha(_))
            };
            let kinds = [one, other].map(std::mem::discriminant);
            let polygon = |quantity: &Quantity| {
                let vector = super::answers::is_vector(quantity) && !plain(quantity);
                let order = Some(quantity.order()).filter(|order| *order != Order::Position);
                order.filter(|_| vector && !matches!(quantity, Quantity::Force(..)))
            };
            let of_pair = |quantity: &Quantity| match quantity {
                Quantity::Force(force, share) => force.pair().map(|_| *share),
                _ => None,
            };
            plain(one) && kinds[0] == kinds[1]
                || polygon(one).is_some() && polygon(one) == polygon(other)
                || of_pair(one).is_some() && of_pair(one) == of_pair(other)
        };
        for (place, &one) in observed.iter().enumerate() {
            for &other in observed[place + 1..].iter().filter(|other| like(&one, other)) {
                let both = [(one, other), (other, one)].map(|(of, by)| Misreading::TakenFor { of, by });
                let change = Change { readings: both.to_vec(), ..Change::default() };
                let (name, how) = (self.name(&one), say!("with {}", self.name(&other)));
                let same = std::mem::discriminant(&one) == std::mem::discriminant(&other);
                self.add_so((Kind::Interchanged, how), &name, None, if same { 0.5 } else { 1.0 }, change);
            }
        }
        // Two letters of a polygon.
        let images: Vec<(&str, Order, Label)> = self
            .case
            .observations
            .iter()
            .filter_map(|observation| match observation.target {
                Target::Image(order, label) => Some((observation.name.as_str(), order, label)),
                _ => None,
            })
            .collect();
        for (place, &(name, order, one)) in images.iter().enumerate() {
            for &(with, _, other) in images[place + 1..].iter().filter(|(_, of, _)| *of == order) {
                let both =
                    [(one, other), (other, one)].map(|(of, by)| Misreading::LetterOf { order, of, by });
                let change = Change { readings: both.to_vec(), ..Change::default() };
                self.add_so((Kind::Interchanged, say!("with {}", with)), name, None, 0.5, change);
            }
        }
    }

    /// ω of a link by the velocity of one of its points over a distance that is not that from its centre, and the distances
    /// of two points from it interchanged.
    fn rates_by_wrong_distances(&mut self) {
        let mechanism = &self.case.mechanism;
        let space = &self.construction.space;
        let mut places: Vec<(String, [f64; 2], Option<PointId>)> = (0..mechanism.points.len())
            .filter_map(|index| {
                Some((mechanism.points[index].name.clone(), space.places[index]?, Some(PointId(index))))
            })
            .collect();
        let mut centres = Vec::new();
        for (index, observation) in self.case.observations.iter().enumerate() {
            if let (Some(of @ Quantity::Centre(i, j)), Some(&[x, y])) =
                (observation.quantity, self.case.truth[index].as_deref())
            {
                let at = [x, y].map(|metres| metres / space.metres_per_mm);
                places.push((self.name(&of), at, None));
                centres.push((i, j, at));
            }
        }
        // Without centres the polygons show from which vector a rate was calculated.
        let Some(images) = polygon(self.construction, Order::Velocity).map(|polygon| &polygon.images) else {
            return;
        };
        let image = |point: PointId| {
            let label = Label::Image { point, link: None };
            images.iter().rev().find(|image| image.label == label).map(|image| size(&image.at))
        };
        let distance = |a: [f64; 2], b: [f64; 2]| size(&difference(a, b)) * space.metres_per_mm;
        let si = self.case.si_per_mm(Order::Velocity);
        // With whether it is a distance of the link itself, which is taken sooner than any other one.
        let mut found: Vec<(LinkId, bool, Phrase, Vec<Misreading>)> = Vec::new();
        let observed: Vec<Quantity> = self.observed();
        let observed: Vec<Quantity> = observed
            .into_iter()
            .filter(|of| matches!(of, Quantity::Omega(_) | Quantity::Velocity(_)))
            .collect();
        for &(i, j, centre) in &centres {
            let link = match (i, j) {
                (LinkId::FRAME, link) | (link, LinkId::FRAME) => link,
                _ => continue,
            };
            let Some(&(_, omega)) = self.omegas().iter().find(|(of, omega)| *of == link && *omega != 0.0)
            else {
                continue;
            };
            let points = &mechanism.link(link).points;
            let twisted = |of: Quantity, factor: f64| Misreading::Twisted {
                of: Which::One(of),
                twist: Twist::scaled(factor),
            };
            for &point in points {
                let (Some(speed), Some(at)) = (image(point), space.places[point.0]) else { continue };
                let own = mechanism.point(point).name.as_str();
                let mut add = |name: &Phrase, length: f64, of_link: bool, more: Option<Misreading>| {
                    let factor = speed * si / length / omega.abs();
                    if length > 0.0 && factor.is_finite() && (factor - 1.0).abs() > 0.01 {
                        let own_rate = twisted(Quantity::Omega(link), factor);
                        // With all that is found by this ω.
                        let all = observed
                            .iter()
                            .filter(|of| !self.is_driven(of) && **of != Quantity::Velocity(point));
                        let all: Vec<Misreading> = all.map(|of| twisted(*of, factor)).collect();
                        let how = say!("V of {} over {}", own, name);
                        if all.len() > 1 {
                            found.push((link, of_link, how.clone(), all));
                        }
                        found.push((link, of_link, how, [own_rate].into_iter().chain(more).collect()));
                    }
                };
                for (place, (from, a, one)) in places.iter().enumerate() {
                    for (to, b, other) in &places[place + 1..] {
                        let own = |of: &Option<PointId>| of.is_some_and(|of| points.contains(&of));
                        add(&say!("{} to {}", from, to), distance(*a, *b), own(one) && own(other), None);
                    }
                }
                for &other in points.iter().filter(|other| **other != point) {
                    let Some(there) = space.places[other.0] else { continue };
                    let ratio = distance(centre, at) / distance(centre, there);
                    let carried = twisted(Quantity::Velocity(other), ratio * ratio);
                    let name = say!("the distance of {}", mechanism.point(other).name);
                    add(&name, distance(centre, there), true, Some(carried));
                }
            }
        }
        let near = found.iter().filter(|(_, of_link, ..)| *of_link).count();
        let prices = [found.len(), near].map(|among| 0.5 + one_of(among) / 4.0);
        for (link, of_link, how, readings) in found {
            let price = prices[usize::from(of_link)];
            let name = self.name(&Quantity::Omega(link));
            let change = Change { readings, ..Change::default() };
            self.add_so((Kind::WrongFormula, how), &name, None, price, change);
        }
    }

    /// Whether an ω or a V is that of a driven link or of a point of it.
    fn is_driven(&self, quantity: &Quantity) -> bool {
        let driven = self.driven();
        match quantity {
            Quantity::Omega(link) => driven.contains(link),
            Quantity::Velocity(point) => {
                driven.iter().any(|link| self.case.mechanism.link(*link).points.contains(point))
            }
            _ => false,
        }
    }

    /// V of a point by that of another of its link and the distances of both from its centre, the ratio the other way up; and ω
    /// of the links that turn with it.
    fn ratios_of_distances(&mut self) {
        let mechanism = &self.case.mechanism;
        let space = &self.construction.space;
        let mut found: Vec<(Quantity, Phrase, Vec<Misreading>)> = Vec::new();
        for (index, observation) in self.case.observations.iter().enumerate() {
            let (Some(Quantity::Centre(i, j)), Some(&[x, y])) =
                (observation.quantity, self.case.truth[index].as_deref())
            else {
                continue;
            };
            let link = match (i, j) {
                (LinkId::FRAME, link) | (link, LinkId::FRAME) => link,
                _ => continue,
            };
            let centre = [x, y].map(|metres| metres / space.metres_per_mm);
            let away = |point: PointId| space.places[point.0].map(|at| size(&difference(at, centre)));
            let points = &mechanism.link(link).points;
            for (&own, &other) in points.iter().flat_map(|own| points.iter().map(move |other| (own, other))) {
                let (Some(near), Some(far)) = (away(own), away(other)) else { continue };
                let of = Quantity::Velocity(own);
                let factor = (far / near) * (far / near);
                if own == other || !self.observed().contains(&of) || !factor.is_finite() {
                    continue;
                }
                let turns = |of: &Quantity| match of {
                    Quantity::Omega(with) => *with != link && mechanism.link(*with).points.contains(&own),
                    _ => false,
                };
                let with: Vec<Quantity> =
                    [of].into_iter().chain(self.observed().into_iter().filter(turns)).collect();
                let readings = with
                    .into_iter()
                    .map(|of| Misreading::Twisted { of: Which::One(of), twist: Twist::scaled(factor) });
                let name = |point: PointId| mechanism.point(point).name.as_str();
                let how = say!("distances of {} and {} interchanged", name(other), name(own));
                found.push((of, how, readings.collect()));
            }
        }
        for (of, how, readings) in found {
            let name = self.name(&of);
            let change = Change { readings, ..Change::default() };
            self.add_so((Kind::RatioInverted, how), &name, None, 0.5, change);
        }
    }

    /// V of the point under a pin taken for that of the pin: nothing slides, and there is no Coriolis.
    fn slip_forgotten(&mut self) {
        let Some(polygon) = polygon(self.construction, Order::Velocity) else { return };
        for image in &polygon.images {
            let Label::Image { point, link: Some(link) } = image.label else { continue };
            let pin = |known: &&crate::graphical::construction::Image| match known.label {
                Label::Image { point: of, link } => {
                    of == point && link.is_none_or(|link| self.case.holds(link, of))
                }
                _ => false,
            };
            let Some(pin) = polygon.images.iter().rev().find(pin).filter(|_| !self.case.holds(link, point))
            else {
                continue;
            };
            let name = self.name(&Quantity::Slip(point, link));
            let under = Departure::Under { order: Order::Velocity, pin: point, link, at: pin.at };
            self.add(Kind::SlipMissing, &name, None, 0.5, Change::drawn(vec![under]));
        }
    }

    /// The diameter of a wheel for its radius in all that is calculated by it, and points of a wheel accelerated as if it turned
    /// about a point at rest.
    fn rolling(&mut self) {
        let mechanism = &self.case.mechanism;
        for &contact in &mechanism.contacts {
            for radius in [2.0, 0.5] {
                let mut departures = Vec::new();
                let mut first: Option<(usize, Quantity)> = None;
                for (step, act) in self.acts() {
                    let (quantity, departure) = match *act {
                        Act::Calculate(
                            Calculation::Speed { quantity, ends, .. }
                            | Calculation::Tangential { quantity, ends, .. },
                        ) if ends.contains(&contact) => {
                            (quantity, Departure::LaidOff { quantity, twist: Twist::scaled(radius) })
                        }
                        Act::Calculate(Calculation::Omega { link, ends, .. }) if ends.contains(&contact) => {
                            let factor = 1.0 / radius;
                            let rate = Departure::Rate { order: Order::Velocity, link, factor };
                            (Quantity::Omega(link), rate)
                        }
                        Act::Calculate(Calculation::Alpha { link, ends, .. }) if ends.contains(&contact) => {
                            let factor = 1.0 / radius;
                            let rate = Departure::Rate { order: Order::Acceleration, link, factor };
                            (Quantity::Alpha(link), rate)
                        }
                        _ => continue,
                    };
                    first = first.or(Some((step, quantity)));
                    if !departures.contains(&departure) {
                        departures.push(departure);
                    }
                }
                if let Some((step, quantity)) = first {
                    let name = self.name(&quantity);
                    let change = Change::drawn(departures);
                    self.add(Kind::DiameterForRadius, &name, Some(step), PLAIN, change);
                }
            }
        }
        self.about_a_contact();
    }

    /// A of a point of a wheel by ω² and ε over its distance from the point of contact, which has an acceleration itself.
    fn about_a_contact(&mut self) {
        let mechanism = &self.case.mechanism;
        let alphas: Vec<(LinkId, f64)> = self.alphas();
        let omegas = self.omegas();
        let (speed, second) =
            (self.case.si_per_mm(Order::Velocity), self.case.si_per_mm(Order::Acceleration));
        let image = |order: Order, point: PointId| {
            let label = Label::Image { point, link: None };
            let images = &polygon(self.construction, order)?.images;
            Some(images.iter().rev().find(|image| image.label == label)?.at)
        };
        let mut found: Vec<(PointId, Departure)> = Vec::new();
        for roll in &mechanism.rolls {
            let bodies = roll.bodies();
            if !bodies.contains(&LinkId::FRAME) {
                continue;
            }
            for &link in bodies.iter().filter(|link| **link != LinkId::FRAME) {
                let rate =
                    |rates: &[(LinkId, f64)]| rates.iter().find(|(of, _)| *of == link).map(|(_, rate)| *rate);
                let (Some(omega), Some(alpha)) = (rate(&omegas).filter(|own| *own != 0.0), rate(&alphas))
                else {
                    continue;
                };
                for &point in &mechanism.link(link).points {
                    let Some(v) = image(Order::Velocity, point) else { continue };
                    if image(Order::Acceleration, point).is_none() {
                        continue;
                    }
                    // Its arm from where the wheel touches: V is square to it.
                    let arm = [v[1], -v[0]].map(|part| part * speed / omega);
                    let at =
                        [-alpha * arm[1] - omega * omega * arm[0], alpha * arm[0] - omega * omega * arm[1]];
                    let at = at.map(|part| part / second);
                    found.push((point, Departure::Image { order: Order::Acceleration, point, at }));
                }
            }
        }
        for (point, departure) in found {
            let name = self.name(&Quantity::Acceleration(point));
            let how = say!("about the point of contact, as if that were at rest");
            self.add_so((Kind::WrongFormula, how), &name, None, 0.5, Change::drawn(vec![departure]));
        }
    }

    /// A_B₂B₄ with Coriolis, which is no part of what slides.
    fn slip_with_coriolis(&mut self) {
        for of in self.observed() {
            let Quantity::SlipAcceleration(point, link) = of else { continue };
            let Some(vector) = vector_of(self.construction, &Quantity::Coriolis(point, link)) else {
                continue;
            };
            let si = self.case.si_per_mm(Order::Acceleration);
            let by = difference(vector.to, vector.from).map(|mm| mm * si);
            let name = self.name(&of);
            let read = Change::read(Misreading::Plus { of, by });
            self.add_so((Kind::WrongFormula, say!("Coriolis was not taken off")), &name, None, 0.25, read);
        }
    }

    /// Numbers that were written down the other way up, or in two figures only, and a rubbing speed with another ω or
    /// arm than its own.
    fn written_otherwise(&mut self) {
        for quantity in self.observed() {
            let name = self.name(&quantity);
            let read = |list: &mut Self, kind: Kind, price: f64, misreading: Misreading| {
                list.add(kind, &name, None, price, Change::read(misreading));
            };
            let twist =
                |factor: f64| Misreading::Twisted { of: Which::One(quantity), twist: Twist::scaled(factor) };
            if self.case.is_rounded(&quantity) {
                read(self, Kind::RoundedCoarsely, PLAIN, Misreading::Rounded { of: quantity });
            }
            match quantity {
                Quantity::Ratio(..) | Quantity::Advantage(..) => {
                    read(self, Kind::RatioInverted, PLAIN, Misreading::Inverted { of: quantity });
                }
                Quantity::Omega(link) => {
                    if self.is_wheel(link) {
                        self.diameter_for_radius(Order::Velocity, link, &name);
                    }
                    // l / V for V / l, and the arms of the common centre of two links exchanged.
                    read(self, Kind::RatioInverted, UNUSUAL, Misreading::Inverted { of: quantity });
                    let mut omegas = self.omegas();
                    omegas.extend(self.case.rates_answered());
                    let Some(&(_, own)) = omegas.iter().find(|(of, own)| *of == link && *own != 0.0) else {
                        continue;
                    };
                    let price = 1.0 + one_of(omegas.len()) / 2.0;
                    for &(_, other) in omegas.iter().filter(|(of, _)| *of != link) {
                        let factor = (other / own) * (other / own);
                        read(self, Kind::RatioInverted, price, twist(factor));
                        // With the ratios that are reckoned from it.
                        let ratios = self.observed().into_iter().filter_map(|ratio| {
                            let factor = match ratio {
                                Quantity::Ratio(of, _) | Quantity::Advantage(_, of) if of == link => factor,
                                Quantity::Ratio(_, of) | Quantity::Advantage(of, _) if of == link => {
                                    1.0 / factor
                                }
                                _ => return None,
                            };
                            Some(Misreading::Twisted { of: Which::One(ratio), twist: Twist::scaled(factor) })
                        });
                        let readings: Vec<Misreading> = [twist(factor)].into_iter().chain(ratios).collect();
                        if readings.len() > 1 {
                            let all = Change { readings, ..Change::default() };
                            self.add(Kind::RatioInverted, &name, None, price, all);
                        }
                    }
                }
                // Of a wheel, V or A over its diameter.
                Quantity::Alpha(link) if self.is_wheel(link) => {
                    self.diameter_for_radius(Order::Acceleration, link, &name);
                }
                Quantity::Rub(_, i, j) => {
                    for factor in [2.0, 0.5] {
                        read(self, Kind::DiameterForRadius, PLAIN, twist(factor));
                    }
                    let omegas = self.omegas();
                    let of = |link: LinkId| match link {
                        LinkId::FRAME => Some(0.0),
                        _ => omegas.iter().find(|(of, _)| *of == link).map(|(_, omega)| *omega),
                    };
                    if let (Some(a), Some(b)) = (of(i), of(j))
                        && a != b
                    {
                        let ways = [
                            (say!("the sum of both ω for their difference"), (a + b) / (a - b)),
                            (say!("one ω alone"), a / (a - b)),
                            (say!("one ω alone"), b / (a - b)),
                        ];
                        for (how, factor) in ways {
                            let kind = (Kind::SenseReversed, how);
                            let change = Change::read(twist(factor.abs()));
                            self.add_so(kind, &name, None, 0.5, change);
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// The rate of a wheel by its diameter, written down, or used as well.
    fn diameter_for_radius(&mut self, order: Order, link: LinkId, name: &str) {
        let (kind, factor) = (Kind::DiameterForRadius, 0.5);
        let quantity = if order == Order::Velocity { Quantity::Omega(link) } else { Quantity::Alpha(link) };
        let twist = Twist::scaled(factor);
        let written = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
        self.add(kind, name, None, 0.5, written);
        self.add(kind, name, None, PLAIN, Change::drawn(vec![Departure::Rate { order, link, factor }]));
    }

    /// Whether a link rolls on another one.
    fn is_wheel(&self, link: LinkId) -> bool {
        self.case.mechanism.rolls.iter().any(|roll| roll.bodies().contains(&link))
    }

    /// A point of the driven link stands at another angle about its pivot.
    fn drawn_at_another_angle(&mut self, point: PointId, at: [f64; 2]) {
        let angles: Vec<(usize, f64, f64)> = self.angles().collect();
        for (input, ..) in angles {
            let (Input::Angle { link, .. } | Input::Speed { link, .. }) = self.case.mechanism.inputs[input]
            else {
                continue;
            };
            let points = &self.case.mechanism.link(link).points;
            let Some(&pivot) = points.first().filter(|pivot| self.case.mechanism.is_fixed(**pivot)) else {
                continue;
            };
            if !points.contains(&point) {
                continue;
            }
            let (Some(base), Some(right)) = (self.place_of_joint(pivot), self.place_of_joint(point)) else {
                continue;
            };
            let [own, right] = [difference(at, base), difference(right, base)];
            let by =
                libm::atan2(right[0] * own[1] - right[1] * own[0], right[0] * own[0] + right[1] * own[1]);
            let name = self.case.mechanism.point(point).name.clone();
            let how = match by < 0.0 {
                true => say!("{} stands {} too far clockwise", name, degrees_of(by)),
                false => say!("{} stands {} too far counter-clockwise", name, degrees_of(by)),
            };
            let change = Change::of_inputs(InputChange::Angle { input, by });
            // Fitted to where the point stands: what says why it stands there is the likelier one.
            self.add_so((Kind::InputAngle, how), say!("the input"), None, UNUSUAL + 1.0, change);
        }
    }

    /// A guide goes through the point that rides on it where the student has it: parallel to the right one, or turned about the
    /// point by which it is given.
    fn drawn_on_another_guide(&mut self, point: PointId, at: [f64; 2]) {
        for guide in super::misread::Guideway::all(&self.case.mechanism) {
            let slide = guide.slide;
            let Rider::Pin { point: rider, .. } = self.case.mechanism.slides[slide].rider else { continue };
            let across = -guide.beside(at);
            if rider != point || across == 0.0 {
                continue;
            }
            let how = say!("{} away", self.told(across.abs()));
            let away = difference(at, guide.through);
            let along = guide.along;
            let sine = along[0] * away[1] - along[1] * away[0];
            let turn = libm::atan(sine / (along[0] * away[0] + along[1] * away[1]));
            let turned = say!("turned by {}", degrees_of(turn));
            let name = self.case.mechanism.point(point).name.clone();
            let shift =
                |across: f64, turn: f64| Change::of_inputs(InputChange::Guide { slide, across, turn });
            // Fitted to where the point stands: what says why it stands there is the likelier one.
            self.add_so((Kind::GuideMisplaced, how), &name, None, 1.0, shift(across, 0.0));
            if turn.is_finite() {
                self.add_so((Kind::GuideMisplaced, turned), &name, None, UNUSUAL + 1.0, shift(0.0, turn));
            }
        }
    }

    /// A point stands on its link where the student has it on his skeleton.
    fn drawn_elsewhere_on_its_link(&mut self, point: PointId, at: [f64; 2]) {
        for link in self.case.mechanism.moving() {
            let points = &self.case.mechanism.link(link).points;
            let Some(end) = points.iter().position(|known| *known == point).filter(|end| *end > 1) else {
                continue;
            };
            let first = points[0];
            let place = |of: PointId| self.case.drawn_place(of).or_else(|| self.place_of_joint(of));
            let (Some(base), Some(from), Some(right)) =
                (place(first), self.place_of_joint(first), self.place_of_joint(point))
            else {
                continue;
            };
            let [own, right] = [difference(at, base), difference(right, from)];
            let turn =
                libm::atan2(right[0] * own[1] - right[1] * own[0], right[0] * own[0] + right[1] * own[1]);
            let factor = size(&own) / size(&right);
            let change = Change::of_inputs(InputChange::Arm { link, end, factor, turn });
            let how = say!("{} for {}", self.told(size(&own)), self.told(size(&right)));
            let name = self.case.mechanism.point(point).name.clone();
            // Mirrored on the line of the two points before it.
            if let Some(second) = self.place_of_joint(points[1]) {
                let base = difference(second, from);
                let across = base[0] * right[1] - base[1] * right[0];
                let along = base[0] * right[0] + base[1] * right[1];
                if across.abs() > ON_LINE * size(&base) * size(&right) {
                    let turn = -2.0 * libm::atan2(across, along);
                    let mirrored = InputChange::Arm { link, end, factor: 1.0, turn };
                    let line =
                        [first, points[1]].map(|p| self.case.mechanism.point(p).name.as_str()).concat();
                    let kind = (Kind::PointLaidOff, say!("on the other side of {}", line));
                    self.add_so(kind, &name, None, PLAIN, Change::of_inputs(mirrored));
                }
            }
            if factor.is_finite() && change.mechanism(&self.case.mechanism).as_ref() != &self.case.mechanism {
                self.add_so((Kind::PointLaidOff, how), &name, None, 0.5, change);
            }
        }
    }

    /// A link that ends at a point is as long as it is on the student's skeleton.
    fn drawn_too_long(&mut self, point: PointId, at: [f64; 2]) {
        for link in self.case.mechanism.moving() {
            let points = self.case.mechanism.link(link).points.clone();
            let Some(own) = points.iter().position(|known| *known == point) else { continue };
            for (other, &end) in points.iter().enumerate().filter(|(other, _)| *other != own) {
                let (Some(right), Some(from)) = (self.place_of_joint(end), self.place_of_joint(point)) else {
                    continue;
                };
                let base = self.case.drawn_place(end).unwrap_or(right);
                let [long, length] = [size(&difference(at, base)), size(&difference(from, right))];
                let name = |id: PointId| self.case.mechanism.point(id).name.clone();
                let at = say!("the length {}", name(end) + &name(point));
                let how = say!("{} for {}", self.told(long), self.told(length));
                let ends = [own.min(other), own.max(other)];
                let change = Change::of_inputs(InputChange::Length { link, ends, factor: long / length });
                if length > 0.0
                    && long > 0.0
                    && change.mechanism(&self.case.mechanism).as_ref() != &self.case.mechanism
                {
                    self.add_so((Kind::LengthLaidOff, how), &at, None, UNUSUAL, change);
                }
            }
        }
    }

    /// Where a joint stands on the drawing so far, metres.
    fn place_of_joint(&self, point: PointId) -> Option<[f64; 2]> {
        let at = self.construction.space.places.get(point.0).copied()??;
        Some(at.map(|mm| mm * self.case.scales.length()))
    }

    /// Directions counted clockwise or from the y axis: every one, or one alone.
    fn directions(&mut self) {
        let quarter = |turn| move |of| Misreading::Twisted { of, twist: Twist { factor: 1.0, turn } };
        let mirrored = |from_y| move |of| Misreading::Mirrored { of, from_y };
        let ways: [(Phrase, f64, Reading<'_>); 4] = [
            (say!("clockwise"), 0.0, &mirrored(false)),
            (say!("clockwise from the y axis"), 0.5, &mirrored(true)),
            (say!("from the y axis"), 0.0, &quarter(-FRAC_PI_2)),
            (say!("from the y axis"), 0.5, &quarter(FRAC_PI_2)),
        ];
        for (how, price, read) in ways {
            let kind = || (Kind::DirectionMeasured, how.clone());
            let all = Change::read(read(Which::AllVectors));
            self.add_so(kind(), say!("the directions"), None, 0.5 + price, all);
            for quantity in self.observed() {
                if super::answers::is_vector(&quantity) && !matches!(quantity, Quantity::Position(_)) {
                    let name = self.name(&quantity);
                    let one = Change::read(read(Which::One(quantity)));
                    self.add_so(kind(), &name, None, UNUSUAL + price, one);
                }
            }
        }
    }

    /// Degrees in the place of radians: in rates that are handed in, and in what follows from them.
    fn degrees(&mut self) {
        let degrees = 180.0 / PI;
        let twisted = |of| Misreading::Twisted { of, twist: Twist::scaled(degrees) };
        self.add(Kind::DegAsRad, say!("the answers"), None, UNUSUAL, Change::read(twisted(Which::Omegas)));
        for quantity in self.observed() {
            let (order, link) = match quantity {
                Quantity::Omega(link) => (Order::Velocity, link),
                Quantity::Alpha(link) => (Order::Acceleration, link),
                _ => continue,
            };
            let name = self.name(&quantity);
            self.add(Kind::DegAsRad, &name, None, UNUSUAL, Change::read(twisted(Which::One(quantity))));
            let carried = Departure::Rate { order, link, factor: degrees };
            self.add(Kind::DegAsRad, &name, None, UNUSUAL + 0.5, Change::drawn(vec![carried]));
        }
    }

    /// Lengths in the wrong unit.
    fn units(&mut self) {
        let symbol = self.case.scene.units.length.symbol.as_str();
        let (kind, near, far): (Kind, [f64; 2], &[f64]) = match symbol {
            "in" => (Kind::InchAsFoot, [12.0, 1.0 / 12.0], &[]),
            "ft" => (Kind::InchAsFoot, [1.0 / 12.0, 12.0], &[]),
            "mm" => (Kind::CmAsMm, [10.0, 0.1], &[1e-3, 1e3]),
            "m" => (Kind::MetreMixed, [0.01, 100.0], &[1e-3, 1e3]),
            _ => (Kind::CmAsMm, [0.1, 10.0], &[0.01, 100.0]),
        };
        for (quantity, factor) in self.case.in_odd_units() {
            let odd = if [0.1, 10.0].into_iter().any(|ten| (factor / ten - 1.0).abs() < SAME_LENGTH) {
                Kind::CmAsMm
            } else if matches!(symbol, "in" | "ft") {
                Kind::InchAsFoot
            } else {
                Kind::MetreMixed
            };
            let name = self.name(&quantity);
            let twisted = Misreading::Twisted { of: Which::One(quantity), twist: Twist::scaled(factor) };
            self.add(odd, &name, None, PLAIN, Change::read(twisted));
        }
        let given_speeds = self.case.mechanism.inputs.iter().any(|i| !matches!(i, Input::Angle { .. }));
        for &factor in far {
            let kind = Kind::MetreMixed;
            for speeds in [true, false] {
                if speeds || given_speeds {
                    let change = InputChange::Lengths { factor, speeds };
                    self.add(kind, say!("all lengths"), None, 1.0, Change::of_inputs(change));
                }
            }
            self.divided_by(kind, factor, 1.0);
            self.answers_in(kind, factor, 1.0);
        }
        for (factor, price) in near.into_iter().zip([PLAIN, 1.0]) {
            for speeds in [true, false] {
                if speeds || given_speeds {
                    let change = InputChange::Lengths { factor, speeds };
                    self.add(kind, say!("all lengths"), None, price, Change::of_inputs(change));
                }
            }
            self.divided_by(kind, factor, price);
            self.answers_in(kind, factor, price);
            self.single_lengths(kind, factor, price);
        }
    }

    /// The lengths by which velocities and accelerations are divided, and no others.
    fn divided_by(&mut self, kind: Kind, factor: f64, price: f64) {
        let rates = self.calculated_rates();
        let departures =
            rates.iter().map(|&(order, link, _)| Departure::Rate { order, link, factor: 1.0 / factor });
        let change = Change::drawn(departures.collect());
        self.add(kind, say!("the lengths by which is divided"), None, price + UNUSUAL, change);
        for &(order, link, step) in &rates {
            let departure = Departure::Rate { order, link, factor: 1.0 / factor };
            let at = say!("the length of link {}", self.number(link));
            self.add(kind, &at, Some(step), price + UNUSUAL, Change::drawn(vec![departure]));
        }
    }

    /// Answers written down in another unit than they were found in.
    fn answers_in(&mut self, kind: Kind, factor: f64, price: f64) {
        let twisted = |of| Change::read(Misreading::Twisted { of, twist: Twist::scaled(factor) });
        self.add(kind, say!("the answers' unit"), None, price + UNUSUAL, twisted(Which::AllLinear));
        for order in [Order::Velocity, Order::Acceleration] {
            // Numbers in the scene's unit beside the other one in which they are written.
            let price = if self.is_written_in_parts(order, factor) { BESIDE_A_UNIT } else { price + FAR };
            self.add(kind, say!("the answers' unit"), None, price, twisted(Which::Vectors(order)));
        }
        for quantity in self.observed() {
            if !of_forces(&quantity) {
                let name = self.name(&quantity);
                self.add(kind, &name, None, price + FAR, twisted(Which::One(quantity)));
            }
        }
    }

    /// Whether all vectors of a polygon that are answered by value are written in a unit that is such a part of the scene's.
    fn is_written_in_parts(&self, order: Order, part: f64) -> bool {
        let unit = self.case.unit_of(order).si;
        let of = |quantity: &Quantity| super::answers::is_vector(quantity) && quantity.order() == order;
        let vectors = self
            .case
            .observations
            .iter()
            .filter(|one| !one.on_paper && one.quantity.as_ref().is_some_and(of));
        let parts: Vec<f64> = vectors.map(|one| one.unit.si / unit).collect();
        !parts.is_empty() && parts.iter().all(|own| (own / part - 1.0).abs() < SAME_LENGTH)
    }

    /// The vectors of a polygon: all, those that are read off it and not calculated before, and of these those that are no
    /// sum of given parts; as far as that are others among the answers.
    fn whole_figures(&self) -> Vec<(Which, Order, Phrase)> {
        let mut scopes: Vec<(Which, Order, Phrase)> = Vec::new();
        for (order, at) in
            [(Order::Velocity, say!("the velocities")), (Order::Acceleration, say!("the accelerations"))]
        {
            let mut known: Vec<Vec<Quantity>> = Vec::new();
            let reads = self.observed().iter().any(|of| self.case.includes(Which::Read(order), of));
            let all =
                [Which::Vectors(order), Which::Read(order), Which::Found(order), Which::Measured(order)];
            for of in all {
                let mut among = self.observed();
                among.retain(|quantity| self.case.includes(of, quantity));
                // Nothing is said of a figure off which answers are read, and none of which it would change.
                let told = among.is_empty() && reads;
                if !told && !known.contains(&among) {
                    known.push(among);
                    scopes.push((of, order, at.clone()));
                }
            }
        }
        scopes
    }

    /// A diagram, or the lengths that are measured on the skeleton, with another scale factor than the drawing's.
    fn wrong_scales(&mut self) {
        let mut measured: Vec<[PointId; 2]> = Vec::new();
        for (_, act) in self.acts() {
            if let Act::MeasureLength { from, to, .. } = *act {
                measured.push([from, to]);
            }
        }
        self.any_scale();
        for (factor, price) in
            [(2.0, PLAIN), (0.5, PLAIN), (10.0, PLAIN), (0.1, PLAIN), (5.0, 1.0), (0.2, 1.0)]
        {
            let how = if factor > 1.0 {
                say!("read {} times too large", factor)
            } else {
                say!("read {} times too small", 1.0 / factor)
            };
            let kind = || (Kind::ScaleWrong, how.clone());
            for (of, order, at) in self.whole_figures() {
                let read = Change::read(Misreading::OtherScale { of, factor });
                self.add_so(kind(), &at, None, price, read.clone());
                // Points of the figure that were converted by the same scale.
                let figure = Change::read(Misreading::Enlarged { order, factor });
                self.add_so(kind(), &at, None, price + 0.5, read.and(&figure));
                let followed = Change::drawn(vec![Departure::ReadAll { order, factor }]);
                self.add_so(kind(), &at, None, price + 0.5, read.and(&followed));
                let rates = self.rates_from(of).into_iter().map(|(_, rate)| Misreading::Twisted {
                    of: Which::One(rate),
                    twist: Twist::scaled(factor),
                });
                let rates = Change { readings: rates.collect(), ..Change::default() };
                if !rates.readings.is_empty() {
                    self.add_so(kind(), &at, None, price + 1.0, read.and(&rates));
                }
            }
            // All that was handed in, read by one wrong scale: nothing is calculated from it on the way.
            let all = [Misreading::OtherScale { of: Which::AllVectors, factor }];
            let rates = self
                .rates_from(Which::AllVectors)
                .into_iter()
                .map(|(_, rate)| Misreading::Twisted { of: Which::One(rate), twist: Twist::scaled(factor) });
            let every = Change { readings: all.into_iter().chain(rates).collect(), ..Change::default() };
            self.add_so(kind(), say!("every reading"), None, price + 0.75, every);
            let departures = self.misused(factor, |[a, b], _| {
                measured.iter().any(|known| *known == [a, b] || *known == [b, a])
            });
            if !departures.is_empty() {
                let at = say!("the lengths measured on the skeleton");
                self.add_so(kind(), at, None, price + 1.0, Change::drawn(departures));
            }
        }
    }

    /// A diagram with any other scale factor, where the vectors that are read off it tell the same one.
    fn any_scale(&mut self) {
        for (order, at) in
            [(Order::Velocity, say!("the velocities")), (Order::Acceleration, say!("the accelerations"))]
        {
            let all = 0..self.case.observations.len();
            let factors: Vec<f64> = all.filter_map(|index| self.case.lengthened(index, order)).collect();
            #[expect(clippy::cast_precision_loss, reason = "answers are few")]
            let factor = factors.iter().sum::<f64>() / factors.len().max(1) as f64;
            let alike = factors.iter().all(|one| (one / factor - 1.0).abs() <= ONE_SCALE);
            // By an odd scale every vector of the diagram is drawn or read, one that was calculated as well.
            let spared = || {
                (0..self.case.observations.len()).any(|index| {
                    let known = self.case.lengthened_by(index, |of| Which::Vectors(order).includes(of));
                    known.is_some_and(|one| (one - 1.0).abs() <= ONE_SCALE / 2.0)
                })
            };
            if factors.is_empty() || !alike || spared() || (factor - 1.0).abs() <= ONE_SCALE {
                continue;
            }
            let times = |factor: f64| super::text::digits(factor, 0.01);
            let how = match factor > 1.0 {
                true => say!("read about {} times too large", times(factor)),
                false => say!("read about {} times too small", times(1.0 / factor)),
            };
            let read = Change::read(Misreading::OtherScale { of: Which::Measured(order), factor });
            let followed = read.and(&Change::drawn(vec![Departure::ReadAll { order, factor }]));
            self.add_so((Kind::ScaleWrong, how), at, None, UNUSUAL + 1.0, followed);
        }
    }

    /// One length in the wrong unit, in every calculation in which it stands; the figure is drawn rightly.
    fn single_lengths(&mut self, kind: Kind, factor: f64, price: f64) {
        let mut ends: Vec<([PointId; 2], LinkId)> = Vec::new();
        for (_, act) in self.acts() {
            let found = match *act {
                Act::Calculate(
                    Calculation::Speed { ends, link, .. }
                    | Calculation::Omega { ends, link, .. }
                    | Calculation::Tangential { ends, link, .. }
                    | Calculation::Alpha { ends, link, .. },
                ) => (ends, link),
                Act::Calculate(Calculation::Normal { quantity, ends, .. }) => {
                    (ends, self.link_of(&quantity, ends))
                }
                _ => continue,
            };
            if !ends.contains(&found) {
                ends.push(found);
            }
        }
        let mut tried: Vec<Vec<Departure>> = Vec::new();
        for &(pair, link) in &ends {
            let [a, b] = pair.map(|p| self.case.mechanism.point(p).name.clone());
            let at = say!("the length {}", a + &b);
            let alone = self.misused(factor, |ends, of| (ends, of) == (pair, link));
            let whole = self.misused(factor, |_, of| of == link);
            for departures in [alone, whole] {
                if departures.is_empty() || tried.contains(&departures) {
                    continue;
                }
                tried.push(departures.clone());
                // Only the rates are written down wrongly, and nothing follows from them.
                let readings = departures.iter().filter_map(|departure| match *departure {
                    Departure::Rate { order, link, factor } => {
                        let rate = match order {
                            Order::Velocity => Quantity::Omega(link),
                            _ => Quantity::Alpha(link),
                        };
                        Some(Misreading::Twisted { of: Which::One(rate), twist: Twist::scaled(factor) })
                    }
                    _ => None,
                });
                let readings: Vec<Misreading> = readings.collect();
                self.add(kind, &at, None, price + 1.0, Change::drawn(departures));
                if !readings.is_empty() {
                    let change = Change { readings, ..Change::default() };
                    self.add(kind, &at, None, price + UNUSUAL, change);
                }
            }
        }
    }

    /// What becomes of every calculation with certain lengths if these are multiplied.
    fn misused(&self, factor: f64, among: impl Fn([PointId; 2], LinkId) -> bool) -> Vec<Departure> {
        let mut departures = Vec::new();
        let mut misuse = |departure: Departure| {
            if !departures.contains(&departure) {
                departures.push(departure);
            }
        };
        for (_, act) in self.acts() {
            match *act {
                Act::Calculate(
                    Calculation::Speed { quantity, ends, link, .. }
                    | Calculation::Tangential { quantity, ends, link, .. },
                ) if among(ends, link) => {
                    misuse(Departure::LaidOff { quantity, twist: Twist::scaled(factor) });
                }
                // From V² / l.
                Act::Calculate(Calculation::Normal { quantity, ends, .. })
                    if among(ends, self.link_of(&quantity, ends)) =>
                {
                    misuse(Departure::LaidOff { quantity, twist: Twist::scaled(1.0 / factor) });
                }
                Act::Calculate(Calculation::Omega { link, ends, .. }) if among(ends, link) => {
                    misuse(Departure::Rate { order: Order::Velocity, link, factor: 1.0 / factor });
                }
                Act::Calculate(Calculation::Alpha { link, ends, .. }) if among(ends, link) => {
                    misuse(Departure::Rate { order: Order::Acceleration, link, factor: 1.0 / factor });
                }
                _ => {}
            }
        }
        departures
    }

    // --- the skeleton --------------------------------------------------------------------------

    fn assemblies(&mut self) {
        let mut others = Vec::new();
        for (step, act) in self.acts() {
            if let Act::MarkIntersection { point, .. } = *act {
                others.push((
                    step,
                    Departure::OtherSide(point),
                    Phrase::from(&self.case.mechanism.point(point).name),
                ));
            }
        }
        for link in self.case.mechanism.moving() {
            let carries = self.case.mechanism.slides.iter().any(|slide| slide.guide.link == link);
            if carries {
                others.push((0, Departure::OtherPose(link), say!("link {}", self.number(link))));
            }
        }
        if others.len() > 1 {
            let all = others.iter().map(|(_, departure, _)| *departure).collect();
            self.add(Kind::WrongAssembly, say!("the skeleton"), None, UNUSUAL, Change::drawn(all));
        }
        for (step, departure, at) in others {
            self.add(Kind::WrongAssembly, &at, Some(step), PLAIN, Change::drawn(vec![departure]));
        }
    }

    // --- vectors of known length ---------------------------------------------------------------

    fn laid_off(&mut self) {
        let (turning, lengths, driven) = (self.turning(), self.lengths(), self.driven());
        self.every_normal();
        for (step, act) in self.acts() {
            match *act {
                Act::Calculate(Calculation::Speed { quantity, .. }) => {
                    let kind = match quantity {
                        Quantity::RelativeVelocity(..) => Kind::RelativeReversed,
                        _ => Kind::SenseReversed,
                    };
                    self.twisted(kind, &quantity, step, PLAIN, Twist::scaled(-1.0));
                    self.quarters(Kind::PerpendicularForParallel, &quantity, step, PLAIN);
                }
                Act::Calculate(Calculation::Normal { quantity, ends, speed, length, value, .. }) => {
                    self.twisted(Kind::NormalMissing, &quantity, step, PLAIN, Twist::scaled(0.0));
                    self.twisted(Kind::NormalAwayFromCentre, &quantity, step, PLAIN, Twist::scaled(-1.0));
                    self.quarters(Kind::PerpendicularForParallel, &quantity, step, PLAIN);
                    if value > 0.0 && speed != 0.0 {
                        let speed = speed.abs();
                        let twist = Twist::scaled(length / speed);
                        let given = driven.contains(&self.link_of(&quantity, ends));
                        let price = if given { PLAIN } else { 0.5 };
                        self.twisted(Kind::NormalNotSquared, &quantity, step, price, twist);
                        self.written(Kind::NormalNotSquared, &quantity, step, twist);
                        for (how, price, factor) in self.squares_forgotten(speed, length) {
                            let (name, twist) = (self.name(&quantity), Twist::scaled(factor));
                            for (change, more) in [
                                (Change::drawn(vec![Departure::LaidOff { quantity, twist }]), 0.0),
                                (Change::read(Misreading::Twisted { of: Which::One(quantity), twist }), 0.25),
                            ] {
                                let kind = (Kind::WrongFormula, how.clone());
                                self.add_so(kind, &name, Some(step), price + more, change);
                            }
                        }
                    }
                    if value > 0.0 {
                        self.normals_of_others(&quantity, step, ends, [speed, length, value], &turning);
                        self.normal_by_other_lengths(&quantity, step, length, &lengths);
                    }
                }
                Act::Calculate(Calculation::Tangential { quantity, link, length, value, .. }) => {
                    let kind = match self.driven().contains(&link) {
                        true => Kind::AlphaSign,
                        false => Kind::SenseReversed,
                    };
                    self.twisted(kind, &quantity, step, 1.0, Twist::scaled(-1.0));
                    self.twisted(Kind::AlphaIgnored, &quantity, step, 1.0, Twist::scaled(0.0));
                    self.quarters(Kind::PerpendicularForParallel, &quantity, step, PLAIN);
                    if value > 0.0 {
                        let price = 0.25 + one_of(lengths.len()) / 3.0;
                        for other in others(&lengths, length) {
                            let twist = Twist::scaled(other / length);
                            let laid_off = Change::drawn(vec![Departure::LaidOff { quantity, twist }]);
                            let kind =
                                (Kind::TangentialWrongLength, say!("with the length {}", self.told(other)));
                            let name = self.name(&quantity);
                            self.add_so(kind, &name, Some(step), price, laid_off);
                        }
                    }
                }
                Act::Calculate(Calculation::SlipNormal { quantity, speed, radius, .. }) => {
                    let ways = if speed > 0.0 { self.squares_forgotten(speed, radius) } else { Vec::new() };
                    for (how, price, factor) in ways {
                        let (name, twist) = (self.name(&quantity), Twist::scaled(factor));
                        let kind = (Kind::WrongFormula, how);
                        let change = Change::drawn(vec![Departure::LaidOff { quantity, twist }]);
                        self.add_so(kind, &name, Some(step), price, change);
                    }
                    self.twisted(Kind::NormalMissing, &quantity, step, PLAIN, Twist::scaled(0.0));
                    self.twisted(Kind::NormalAwayFromCentre, &quantity, step, PLAIN, Twist::scaled(-1.0));
                    self.quarters(Kind::PerpendicularForParallel, &quantity, step, PLAIN);
                }
                Act::Calculate(Calculation::Coriolis { quantity, omega, link, slip, .. }) => {
                    for (other, factor) in self.other_speeds(&slip) {
                        let departure = Departure::LaidOff { quantity, twist: Twist::scaled(factor) };
                        let kind = (Kind::CoriolisWrongVelocity, say!("with {}", other));
                        let name = self.name(&quantity);
                        self.add_so(kind, &name, Some(step), 0.5, Change::drawn(vec![departure]));
                    }
                    self.twisted(Kind::CoriolisMissing, &quantity, step, PLAIN, Twist::scaled(0.0));
                    self.twisted(Kind::CoriolisWithoutTwo, &quantity, step, PLAIN, Twist::scaled(0.5));
                    self.written(Kind::CoriolisWithoutTwo, &quantity, step, Twist::scaled(0.5));
                    self.twisted(Kind::CoriolisWrongTurn, &quantity, step, PLAIN, Twist::scaled(-1.0));
                    self.quarters(Kind::CoriolisWrongTurn, &quantity, step, UNUSUAL);
                    if omega != 0.0 {
                        for other in self.omegas() {
                            if other.0 != link && other.1 != 0.0 {
                                let twist = Twist::scaled(other.1 / omega);
                                self.twisted(Kind::CoriolisWrongOmega, &quantity, step, PLAIN, twist);
                                let kept = Twist::scaled((other.1 / omega).abs());
                                self.twisted(Kind::CoriolisWrongOmega, &quantity, step, 1.0, kept);
                            }
                        }
                    }
                }
                _ => {}
            }
        }
    }

    /// One calculation with half or twice the length that stands in it.
    fn lengths_halved(&mut self) {
        let driven = self.driven();
        for (step, act) in self.acts() {
            // What becomes of it with twice the length, and whether that is a rate.
            let (quantity, doubled, rate) = match *act {
                Act::Calculate(
                    Calculation::Speed { quantity, .. } | Calculation::Tangential { quantity, .. },
                ) => (quantity, 2.0, None),
                Act::Calculate(Calculation::Normal { quantity, ends, value, .. }) if value > 0.0 => {
                    let given = driven.contains(&self.link_of(&quantity, ends));
                    (quantity, if given { 2.0 } else { 0.5 }, None)
                }
                Act::Calculate(Calculation::Omega { link, .. }) => {
                    (Quantity::Omega(link), 0.5, Some((Order::Velocity, link)))
                }
                Act::Calculate(Calculation::Alpha { link, .. }) => {
                    (Quantity::Alpha(link), 0.5, Some((Order::Acceleration, link)))
                }
                _ => continue,
            };
            let kind = match act {
                Act::Calculate(Calculation::Normal { .. }) => Kind::NormalOfWrongLink,
                _ => Kind::TangentialWrongLength,
            };
            let name = self.name(&quantity);
            for (how, factor) in [
                (say!("with twice its own length"), doubled),
                (say!("with half its own length"), 1.0 / doubled),
            ] {
                let twist = Twist::scaled(factor);
                let departure = match rate {
                    Some((order, link)) => Departure::Rate { order, link, factor },
                    None => Departure::LaidOff { quantity, twist },
                };
                let drawn = Change::drawn(vec![departure]);
                self.add_so((kind, how.clone()), &name, Some(step), 1.25, drawn);
                let read = Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
                self.add_so((kind, how), &name, Some(step), 1.5, read);
            }
        }
    }

    /// The velocities of what slides and of what lies under it, against that of sliding.
    fn other_speeds(&self, slip: &Quantity) -> Vec<(String, f64)> {
        let Quantity::Slip(point, link) = *slip else { return Vec::new() };
        let long = |quantity: &Quantity| {
            vector_of(self.construction, quantity).map(|vector| size(&difference(vector.to, vector.from)))
        };
        let Some(own) = long(slip).filter(|own| *own > 0.0) else { return Vec::new() };
        let others = [Quantity::Velocity(point), Quantity::CoincidentVelocity(point, link)];
        others.iter().filter_map(|other| Some((self.name(other), long(other)? / own))).collect()
    }

    /// The normal parts that are calculated, each with its link.
    fn normal_parts(&self) -> Vec<(Quantity, LinkId)> {
        let normal = |(_, act): (usize, &Act)| match *act {
            Act::Calculate(Calculation::Normal { quantity, ends, .. }) => {
                Some((quantity, self.link_of(&quantity, ends)))
            }
            _ => None,
        };
        self.acts().into_iter().filter_map(normal).collect()
    }

    /// V/l and V² for V²/l, of a point with this velocity at this distance, as factors of what is right. As numbers they hang
    /// on the unit of length: that of the scene or of an answer is the likelier one.
    fn squares_forgotten(&self, speed: f64, length: f64) -> Vec<(Phrase, f64, f64)> {
        let of_answers = self.case.observations.iter().filter_map(|observation| {
            let vector = observation.quantity.filter(super::answers::is_vector)?;
            let time = self.case.scene.units.time.si;
            let time = if vector.order() == Order::Acceleration { time * time } else { time };
            Some(observation.unit.si * time)
        });
        let mut units: Vec<(f64, f64)> = Vec::new();
        let likely = [self.case.scene.units.length.si].into_iter().chain(of_answers).map(|unit| (unit, 0.5));
        for (unit, price) in likely.chain([1.0, 0.01, 0.001].map(|unit| (unit, 1.0))) {
            if !units.iter().any(|(known, _)| (known / unit - 1.0).abs() < SAME_LENGTH) {
                units.push((unit, price));
            }
        }
        let ways = |(unit, price): (f64, f64)| {
            [
                (say!("V/l in the place of V²/l"), price, unit / speed),
                (say!("V² without its length"), price + 0.25, length / unit),
            ]
        };
        units.into_iter().flat_map(ways).collect()
    }

    /// Several normal parts at once: outward, or reckoned by ω·l, V/l or V².
    fn every_normal(&mut self) {
        let driven = self.driven();
        let normals: Vec<(Quantity, bool, [f64; 2])> = self
            .acts()
            .into_iter()
            .filter_map(|(_, act)| match *act {
                Act::Calculate(Calculation::Normal { quantity, ends, speed, length, value, .. }) => {
                    let given = driven.contains(&self.link_of(&quantity, ends));
                    Some((quantity, given, [if value > 0.0 { speed.abs() } else { 0.0 }, length]))
                }
                _ => None,
            })
            .collect();
        let found = normals.iter().filter(|(_, given, _)| !given).count();
        for (all, at) in [(true, say!("every normal part")), (false, say!("every normal part that is found"))]
        {
            let of = || normals.iter().filter(move |(_, given, _)| all || !given);
            if of().count() < 2 || (all && found == normals.len()) {
                continue;
            }
            // What is zero stays so.
            let drawn = |factor: &dyn Fn([f64; 2]) -> f64| {
                let twist = |of: [f64; 2]| Twist::scaled(if of[0] == 0.0 { 1.0 } else { factor(of) });
                let laid_off =
                    of().map(|&(quantity, _, of)| Departure::LaidOff { quantity, twist: twist(of) });
                Change::drawn(laid_off.collect())
            };
            self.add(Kind::NormalAwayFromCentre, &at, None, 1.0, drawn(&|_| -1.0));
            self.add(Kind::NormalNotSquared, at.clone(), None, 0.5, drawn(&|[speed, length]| length / speed));
            for (way, (how, price, _)) in self.squares_forgotten(1.0, 1.0).into_iter().enumerate() {
                let change = drawn(&|[speed, length]| self.squares_forgotten(speed, length)[way].2);
                self.add_so((Kind::WrongFormula, how), &at, None, price, change);
            }
        }
    }

    fn twisted(&mut self, kind: Kind, quantity: &Quantity, step: usize, price: f64, twist: Twist) {
        let laid_off = |quantity: Quantity| Departure::LaidOff { quantity, twist };
        let name = self.name(quantity);
        self.add(kind, &name, Some(step), price, Change::drawn(vec![laid_off(*quantity)]));
        // Further points of the link by its image have the same fault.
        let own = self.normals.iter().find(|(of, _)| of == quantity);
        let beside = |of: LinkId| self.normals.iter().filter(move |(_, link)| *link == of);
        let image: Vec<Departure> =
            own.map_or_else(Vec::new, |(_, link)| beside(*link).map(|(of, _)| laid_off(*of)).collect());
        if image.len() > 1 {
            self.add(kind, &name, Some(step), price + BY_IMAGE, Change::drawn(image));
        }
    }

    /// The same of the number alone: what follows from it was drawn rightly, or by another.
    fn written(&mut self, kind: Kind, quantity: &Quantity, step: usize, twist: Twist) {
        let read = Change::read(Misreading::Twisted { of: Which::One(*quantity), twist });
        let name = self.name(quantity);
        self.add(kind, &name, Some(step), 1.0, read);
    }

    fn quarters(&mut self, kind: Kind, quantity: &Quantity, step: usize, price: f64) {
        for turn in [FRAC_PI_2, -FRAC_PI_2] {
            self.twisted(kind, quantity, step, price, Twist { factor: 1.0, turn });
        }
    }

    /// ω² l, V² / l or the direction of another link in the place of the own one.
    fn normals_of_others(
        &mut self,
        quantity: &Quantity,
        step: usize,
        ends: [PointId; 2],
        [speed, length, value]: [f64; 3],
        turning: &[Turning],
    ) {
        let own = self.link_of(quantity, ends);
        let Some(angle) = self.angle(ends) else { return };
        // Of what is driven ω is given: nobody looks for another one.
        let given = if self.driven().contains(&own) { UNUSUAL } else { 0.0 };
        let price = given + one_of(turning.len());
        for other in turning.iter().filter(|other| other.link != own) {
            let other_speed = other.omega * other.length;
            let sizes = [
                other.omega * other.omega * length,
                other_speed * other_speed / other.length,
                other_speed * other_speed / length,
                speed * speed / other.length,
            ];
            for size in sizes {
                let factor = size / value;
                self.twisted(Kind::NormalOfWrongLink, quantity, step, price, Twist::scaled(factor));
            }
            let whole = other_speed * other_speed / other.length / value;
            for turn in [other.angle - angle, other.angle - angle + PI] {
                self.twisted(
                    Kind::NormalOfWrongLink,
                    quantity,
                    step,
                    1.0 + price,
                    Twist { factor: 1.0, turn },
                );
                self.twisted(
                    Kind::NormalOfWrongLink,
                    quantity,
                    step,
                    1.0 + price,
                    Twist { factor: whole, turn },
                );
            }
        }
    }

    /// ω² l or V² / l with the own ω or V, and another length.
    fn normal_by_other_lengths(&mut self, quantity: &Quantity, step: usize, length: f64, lengths: &[f64]) {
        let name = self.name(quantity);
        let price = 0.5 + one_of(2 * lengths.len()) / 3.0;
        for other in others(lengths, length) {
            let how = say!("with the length {}", self.told(other));
            for factor in [other / length, length / other] {
                let twist = Twist::scaled(factor);
                let laid_off = Change::drawn(vec![Departure::LaidOff { quantity: *quantity, twist }]);
                let kind = (Kind::NormalOfWrongLink, how.clone());
                self.add_so(kind, &name, Some(step), price, laid_off);
            }
        }
    }

    /// A length as the scene writes lengths.
    pub(super) fn told(&self, metres: f64) -> String {
        let unit = &self.case.scene.units.length;
        let number = metres / unit.si;
        format!("{} {}", super::text::digits(number, number.abs() / 100.0), unit.symbol)
    }

    // --- centres -------------------------------------------------------------------------------

    /// Centres on a line through two centres that have no third link in common.
    fn centres(&mut self, so_far: &Sketch) {
        for (index, observation) in self.case.observations.iter().enumerate() {
            let (Some(of @ Quantity::Centre(..)), Some(&[x, y])) =
                (observation.quantity, self.case.truth[index].as_deref())
            else {
                continue;
            };
            let name = self.name(&of);
            let found = super::routes::on_wrong_lines(self.case, so_far, index);
            let price = 0.5 + one_of(found.len()) / 2.0;
            for (how, at) in found {
                let change = Change::read(Misreading::Plus { of, by: [at[0] - x, at[1] - y] });
                self.add_so((Kind::WrongCentreLine, how), &name, None, price, change);
            }
        }
    }

    // --- lines of unknown length ---------------------------------------------------------------

    fn rays(&mut self) {
        let mut all: Vec<(usize, Order, Departure)> = Vec::new();
        for (number, step) in self.construction.steps.iter().enumerate() {
            let Some(order) = step.diagram.order() else { continue };
            for act in &step.acts {
                if let Act::DrawRay { claim, .. } = *act {
                    let ray = Departure::Ray { order, claim };
                    if !all.iter().any(|(_, _, known)| *known == ray) {
                        all.push((number, order, ray));
                    }
                }
            }
        }
        for &(step, order, ray) in &all {
            let at = self.sought(step, order);
            let how = match ray {
                Departure::Ray { claim: claim @ Claim::Parallel(of), .. } => {
                    Some(say!("⊥ {} instead of {}", self.line(of), self.claim(claim)))
                }
                Departure::Ray { claim: claim @ Claim::Perpendicular(of), .. } => {
                    Some(say!("∥ {} instead of {}", self.line(of), self.claim(claim)))
                }
                _ => None,
            };
            self.found.push(Hypothesis {
                kind: Kind::PerpendicularForParallel,
                at: Phrase::from(&at),
                step: Some(step),
                price: PLAIN,
                change: Change::drawn(vec![ray]),
                how,
            });
            let both: Vec<Departure> = all.iter().filter(|r| r.0 == step).map(|r| r.2).collect();
            if both.len() > 1 && both[0] == ray {
                // Of a slot the parallel and the square line are exchanged; the sense of a rotation by a velocity along
                // its arm may be any.
                let guided = both.iter().find_map(|departure| match *departure {
                    Departure::Ray {
                        claim:
                            Claim::Parallel(Reference::Guide(slide))
                            | Claim::Perpendicular(Reference::Guide(slide)),
                        ..
                    } => Some(self.case.mechanism.slides.get(slide)?.guide.link),
                    _ => None,
                });
                if let Some(link) = guided {
                    let turned = Departure::Rate { order, link, factor: -1.0 };
                    let other = [&both[..], &[turned]].concat();
                    self.add(Kind::PerpendicularForParallel, &at, Some(step), UNUSUAL, Change::drawn(other));
                }
                self.add(Kind::PerpendicularForParallel, &at, Some(step), UNUSUAL, Change::drawn(both));
            }
        }
        for order in [Order::Velocity, Order::Acceleration] {
            let whole: Vec<Departure> = all.iter().filter(|r| r.1 == order).map(|r| r.2).collect();
            if whole.len() > 2 {
                self.add(Kind::PerpendicularForParallel, say!("every line"), None, FAR, Change::drawn(whole));
            }
        }
    }

    /// Lines that were drawn parallel or square to another line of the skeleton.
    fn stray_lines(&mut self) {
        let mut known: Vec<(Reference, [f64; 2])> = Vec::new();
        let mut references: Vec<Reference> = Vec::new();
        for link in self.case.mechanism.moving() {
            if let [a, b, ..] = self.case.mechanism.link(link).points[..] {
                references.push(Reference::Points(a, b));
            }
        }
        // The line of the fixed pivots comes last: it is the least likely.
        let fixed: Vec<PointId> = (0..self.case.mechanism.points.len())
            .map(PointId)
            .filter(|point| self.case.mechanism.is_fixed(*point))
            .collect();
        let frame = fixed.windows(2).map(|two| Reference::Points(two[0], two[1]));
        let mut rays: Vec<(usize, Order, Claim)> = Vec::new();
        for (number, step) in self.construction.steps.iter().enumerate() {
            let Some(order) = step.diagram.order() else { continue };
            for act in &step.acts {
                if let Act::DrawRay { claim, .. } = *act {
                    rays.push((number, order, claim));
                    let (Claim::Parallel(of) | Claim::Perpendicular(of)) = claim;
                    references.push(of);
                }
            }
        }
        rays.dedup_by_key(|(_, order, claim)| (*order as u8, *claim));
        let skeleton = self.case.with_this_skeleton(self.construction);
        for reference in references.into_iter().chain(frame) {
            let Some(along) = direction(skeleton, reference) else { continue };
            // A line as steep as one before leads to nothing new.
            if known.iter().all(|(_, other)| sine(along, *other) > TOLD_APART) {
                known.push((reference, along));
            }
        }
        let price = UNUSUAL + 1.0 + one_of(2 * known.len()) / 2.0;
        for (step, order, claim) in rays {
            let Some(right) = claimed(skeleton, claim) else { continue };
            let at = self.sought(step, order);
            for &(by, along) in &known {
                for square in [false, true] {
                    let drawn = if square { [-along[1], along[0]] } else { along };
                    // Square to its own line is a mistake of another name.
                    if !apart(drawn, right) || sine(drawn, [-right[1], right[0]]) <= TOLD_APART {
                        continue;
                    }
                    let how = match square {
                        true => say!("⊥ {} instead of {}", self.line(by), self.claim(claim)),
                        false => say!("∥ {} instead of {}", self.line(by), self.claim(claim)),
                    };
                    let change = Change::strayed(Stray { order, claim, by, square });
                    self.add_so((Kind::WrongLine, how), &at, Some(step), price, change);
                }
            }
        }
    }

    fn line(&self, of: Reference) -> Phrase {
        match of {
            Reference::Points(a, b) => {
                [a, b].map(|p| self.case.mechanism.point(p).name.as_str()).concat().into()
            }
            Reference::Guide(_) => say!("the guide"),
        }
    }

    fn claim(&self, claim: Claim) -> Phrase {
        match claim {
            Claim::Parallel(of) => say!("∥ {}", self.line(of)),
            Claim::Perpendicular(of) => say!("⊥ {}", self.line(of)),
        }
    }

    /// What the lines of a step lead to.
    fn sought(&self, step: usize, order: Order) -> String {
        let acts = &self.construction.steps[step].acts;
        let label = acts.iter().find_map(|act| match act {
            Act::MarkMeet { label, .. } => Some(*label),
            _ => None,
        });
        label.map_or_else(String::new, |label| {
            let sheet = &self.case.right.construction;
            crate::sheet::image_symbol(self.case.scene, sheet, label, order.diagram()).plain
        })
    }

    // --- calculated rates ----------------------------------------------------------------------

    fn rates(&mut self) {
        let lengths = self.lengths();
        for (step, act) in self.acts() {
            match *act {
                Act::Calculate(Calculation::Omega { link, quantity, length, .. }) => {
                    self.other_rates(link, &quantity, step, (length, &lengths));
                    let rate = |factor| Departure::Rate { order: Order::Velocity, link, factor };
                    let at = self.name(&Quantity::Omega(link));
                    self.add(Kind::SenseReversed, &at, Some(step), PLAIN, Change::drawn(vec![rate(-1.0)]));
                    if matches!(quantity, Quantity::RelativeVelocity(..)) {
                        self.taken_back(quantity, vec![rate(-1.0)], step);
                    }
                }
                Act::Calculate(Calculation::Alpha { link, quantity, length, tangential, .. }) => {
                    let rate = |factor| Departure::Rate { order: Order::Acceleration, link, factor };
                    let at = self.name(&Quantity::Alpha(link));
                    self.add(Kind::AlphaSign, &at, Some(step), 1.0, Change::drawn(vec![rate(-1.0)]));
                    self.add(Kind::SenseReversed, &at, Some(step), 0.5, Change::drawn(vec![rate(-1.0)]));
                    self.add(Kind::AlphaIgnored, &at, Some(step), UNUSUAL, Change::drawn(vec![rate(0.0)]));
                    if let Some(factor) = self.whole_for_tangential(&quantity, tangential) {
                        let how = say!("from the whole acceleration, not its tangential part");
                        let kind = || (Kind::RateFromWrongVector, how.clone());
                        let drawn = Change::drawn(vec![rate(factor)]);
                        self.add_so(kind(), &at, Some(step), 0.25, drawn);
                        let (of, twist) = (Which::One(Quantity::Alpha(link)), Twist::scaled(factor));
                        let read = Change::read(Misreading::Twisted { of, twist });
                        self.add_so(kind(), &at, Some(step), 0.5, read);
                    }
                    if matches!(quantity, Quantity::RelativeTangential(..)) {
                        self.taken_back(quantity, vec![rate(-1.0)], step);
                    }
                    let price = 0.25 + one_of(lengths.len()) / 3.0;
                    for other in others(&lengths, length) {
                        let how = say!("with the length {}", self.told(other));
                        let kind = || (Kind::TangentialWrongLength, how.clone());
                        let change = Change::drawn(vec![rate(length / other)]);
                        self.add_so(kind(), &at, Some(step), price, change);
                        // Further points by the image: nothing follows from the number.
                        let (of, twist) = (Which::One(Quantity::Alpha(link)), Twist::scaled(length / other));
                        let change = Change::read(Misreading::Twisted { of, twist });
                        self.add_so(kind(), &at, Some(step), price, change);
                    }
                }
                _ => {}
            }
        }
    }

    /// How many times longer than its tangential part (SI) a whole acceleration is, absolute or relative.
    fn whole_for_tangential(&self, quantity: &Quantity, tangential: f64) -> Option<f64> {
        let images = &polygon(self.construction, Order::Acceleration)?.images;
        let image = |point: PointId| {
            let label = Label::Image { point, link: None };
            let fixed = self.case.mechanism.is_fixed(point).then_some([0.0; 2]);
            fixed.or_else(|| images.iter().rev().find(|image| image.label == label).map(|image| image.at))
        };
        let whole = match *quantity {
            Quantity::Tangential(point) => image(point)?,
            Quantity::RelativeTangential(to, from) => difference(image(to)?, image(from)?),
            _ => return None,
        };
        let factor = size(&whole) * self.case.si_per_mm(Order::Acceleration) / tangential;
        Some(factor).filter(|factor| factor.is_finite())
    }

    /// ω from the velocity of another point, or over another length; and the normal parts with that ω.
    fn other_rates(
        &mut self,
        link: LinkId,
        quantity: &Quantity,
        step: usize,
        (length, lengths): (f64, &[f64]),
    ) {
        let at = self.name(&Quantity::Omega(link));
        let mut ways: Vec<(Kind, Option<Phrase>, f64)> = Vec::new();
        if let Some(polygon) = polygon(self.construction, Order::Velocity) {
            let own = vector_of(self.construction, quantity).map(|v| size(&difference(v.to, v.from)));
            for other in polygon.vectors.iter().filter(|other| other.quantity != *quantity) {
                let factor = own.map(|own| size(&difference(other.to, other.from)) / own);
                if let Some(factor) = factor.filter(|factor| factor.is_finite() && *factor > 0.0) {
                    let how = say!("from {}", self.name(&other.quantity));
                    ways.push((Kind::RateFromWrongVector, Some(how), factor));
                }
            }
        }
        for other in others(lengths, length) {
            let how = say!("with the length {}", self.told(other));
            ways.push((Kind::TangentialWrongLength, Some(how), length / other));
        }
        let price = 1.0 + one_of(ways.len()) / 2.0;
        // The number alone, where all else goes on from the polygon.
        let alone = ways.iter().filter(|(kind, ..)| *kind == Kind::TangentialWrongLength);
        for (kind, how, factor) in alone.cloned().collect::<Vec<_>>() {
            let twist = Twist::scaled(factor);
            let read = Change::read(Misreading::Twisted { of: Which::One(Quantity::Omega(link)), twist });
            if let Some(how) = how {
                self.add_so((kind, how), &at, Some(step), price + 0.25, read);
            }
        }
        let normals: Vec<Quantity> = self
            .acts()
            .into_iter()
            .filter_map(|(_, act)| match *act {
                Act::Calculate(Calculation::Normal { quantity, ends, .. }) => {
                    (self.link_of(&quantity, ends) == link).then_some(quantity)
                }
                _ => None,
            })
            .collect();
        for (kind, how, factor) in ways {
            let rate = Departure::Rate { order: Order::Velocity, link, factor };
            let squared = Twist::scaled(factor * factor);
            let laid = normals.iter().map(|&quantity| Departure::LaidOff { quantity, twist: squared });
            let followed: Vec<Departure> = [rate].into_iter().chain(laid).collect();
            for change in [vec![rate], followed] {
                let change = Change::drawn(change);
                let (at, step) = (Phrase::from(&at), Some(step));
                self.found.push(Hypothesis { kind, at, step, price, change, how: how.clone() });
            }
        }
    }

    /// A relative vector the wrong way round, and what was calculated from it.
    fn taken_back(&mut self, quantity: Quantity, departures: Vec<Departure>, step: usize) {
        let twist = Twist::scaled(-1.0);
        let reading = Misreading::Twisted { of: Which::One(quantity), twist };
        let name = self.name(&quantity);
        let change = Change { departures, readings: vec![reading], ..Change::default() };
        // Where the vector was not handed in, the sense of what was is the nearer name.
        let price = if self.observed().contains(&quantity) { PLAIN } else { 1.0 };
        self.add(Kind::RelativeReversed, &name, Some(step), price, change);
    }

    // --- images --------------------------------------------------------------------------------

    /// A point on the line of two others of its link, divided off from the wrong end.
    fn divided_off(&mut self) {
        let mechanism = &self.case.mechanism;
        let mut found: Vec<(PointId, Vec<Departure>)> = Vec::new();
        for link in mechanism.moving() {
            let points = &mechanism.link(link).points;
            for &point in points {
                let others: Vec<PointId> = points.iter().copied().filter(|other| *other != point).collect();
                let [a, b] = others[..] else { continue };
                let departures: Vec<Departure> = [Order::Velocity, Order::Acceleration]
                    .into_iter()
                    .filter_map(|order| {
                        let images = &polygon(self.construction, order)?.images;
                        let at = |of: PointId| {
                            let fixed = mechanism.is_fixed(of).then_some([0.0; 2]);
                            let own = Label::Image { point: of, link: None };
                            fixed.or_else(|| Some(images.iter().rev().find(|i| i.label == own)?.at))
                        };
                        let [a, b, own] = [at(a)?, at(b)?, at(point)?];
                        let at = [a[0] + b[0] - own[0], a[1] + b[1] - own[1]];
                        Some(Departure::Image { order, point, at })
                    })
                    .collect();
                let bent = !matches!(mechanism.link(link).form, Form::Line(_));
                if !bent && !mechanism.is_fixed(point) && !departures.is_empty() {
                    found.push((point, departures));
                }
            }
        }
        for (point, departures) in found {
            let at = self.case.mechanism.point(point).name.clone();
            for departure in &departures {
                let change = Change::drawn(vec![*departure]);
                self.add(Kind::ProportionFromOtherEnd, &at, None, 0.5, change);
            }
            self.add(Kind::ProportionFromOtherEnd, &at, None, PLAIN, Change::drawn(departures));
        }
    }

    /// A point of a straight link laid off from the other end, in the skeleton and so in all that hangs on it.
    fn laid_off_from_other_end(&mut self) {
        let mechanism = &self.case.mechanism;
        for link in mechanism.moving() {
            let Form::Line(places) = &mechanism.link(link).form else { continue };
            let points = &mechanism.link(link).points;
            for (end, (place, &point)) in places.iter().zip(points).enumerate().skip(1) {
                let own = place.value - places[0].value;
                let others = places.iter().zip(points).skip(1).filter(|(_, other)| **other != point);
                for (other, from) in others {
                    let factor = (other.value - place.value) / own;
                    if factor.is_finite() && factor != 0.0 && (factor - 1.0).abs() > SAME_LENGTH {
                        let at = mechanism.point(point).name.clone();
                        let how = say!("from {}", mechanism.point(*from).name);
                        let change = Change::of_inputs(InputChange::Length { link, ends: [0, end], factor });
                        self.add_so((Kind::ProportionFromOtherEnd, how), &at, None, 0.25, change);
                    }
                }
                // Between the ends of its link, where most points stand.
                let far = places.iter().map(|place| place.value).fold(places[0].value, |far, place| {
                    if (place - places[0].value).abs() > (far - places[0].value).abs() { place } else { far }
                });
                let factor = (far - places[0].value) / 2.0 / own;
                if factor.is_finite()
                    && (0.5 + SAME_LENGTH..).contains(&factor)
                    && (factor - 1.0).abs() > SAME_LENGTH
                {
                    let at = mechanism.point(point).name.clone();
                    let change = Change::of_inputs(InputChange::Length { link, ends: [0, end], factor });
                    let how = (Kind::PointLaidOff, say!("in the middle of its link"));
                    self.add_so(how, &at, None, 1.0, change);
                }
            }
        }
    }

    /// The vector of a point that is found by its image turned about, that of another point of the link taken for it, or
    /// one part of an acceleration for the whole.
    fn image_taken_otherwise(&mut self, point: PointId, others: &[PointId]) {
        for order in [Order::Velocity, Order::Acceleration] {
            let whole = |point: PointId| match order {
                Order::Velocity => Quantity::Velocity(point),
                _ => Quantity::Acceleration(point),
            };
            let Some(images) = polygon(self.construction, order).map(|polygon| &polygon.images) else {
                continue;
            };
            let image = |point: PointId| {
                let label = Label::Image { point, link: None };
                images.iter().rev().find(|image| image.label == label).map(|image| image.at)
            };
            let Some(own) = image(point) else { continue };
            let name = self.name(&whole(point));
            let mut ways = vec![(Kind::SenseReversed, None, 0.25, own.map(|x| -x))];
            for other in others {
                let taken = image(*other).map(|at| {
                    let how = say!("that of {}", self.case.mechanism.point(*other).name);
                    (Kind::NeighbourRead, Some(how), 1.0, at)
                });
                ways.extend(taken);
            }
            // That of the point under what slides on the link, without the proportion.
            ways.extend(images.iter().filter_map(|image| match image.label {
                Label::Image { point: rider, link: Some(link) }
                    if self.case.holds(link, point) && !self.case.holds(link, rider) =>
                {
                    let name = &self.case.mechanism.point(rider).name;
                    let how = say!("that of {}", format!("{name}{}", self.number(link)));
                    Some((Kind::NeighbourRead, Some(how), 1.0, image.at))
                }
                _ => None,
            }));
            ways.extend(
                self.with_other_radii(point, others).into_iter().map(|(how, factor)| {
                    (Kind::TangentialWrongLength, Some(how), 1.0, own.map(|x| x * factor))
                }),
            );
            if let (Order::Acceleration, Some(normal)) = (order, self.normal_about_pivot(point, others)) {
                let left_out = Some(say!("of its acceleration"));
                ways.push((Kind::NormalMissing, left_out, 0.5, difference(own, normal)));
                ways.push((Kind::AlphaIgnored, None, 0.5, normal));
            }
            for (kind, how, price, at) in ways {
                let name = match kind {
                    Kind::NormalMissing => self.name(&Quantity::Normal(point)),
                    _ => name.clone(),
                }
                .into();
                let change = Change::drawn(vec![Departure::Image { order, point, at }]);
                self.found.push(Hypothesis { kind, at: name, step: None, price, change, how });
            }
        }
    }

    /// How many times longer the vector of a point becomes by the distance of another point of its link from their pivot.
    fn with_other_radii(&self, point: PointId, others: &[PointId]) -> Vec<(Phrase, f64)> {
        let mechanism = &self.case.mechanism;
        let Some(&pivot) = others.iter().find(|other| mechanism.is_fixed(**other)) else { return Vec::new() };
        let places = &self.construction.space.places;
        let far = |of: PointId| Some(size(&difference(places[of.0]?, places[pivot.0]?)));
        let Some(own) = far(point).filter(|own| *own > 0.0) else { return Vec::new() };
        let turning = others.iter().filter(|other| !mechanism.is_fixed(**other));
        let way = |other: &PointId| {
            let factor = far(*other)? / own;
            let line = [pivot, *other].map(|p| mechanism.point(p).name.as_str()).concat();
            ((factor - 1.0).abs() > SAME_LENGTH).then(|| (say!("with the length {}", line), factor))
        };
        turning.filter_map(way).collect()
    }

    /// ω² l of a point about a fixed one of its link, millimetres of the acceleration polygon.
    fn normal_about_pivot(&self, point: PointId, others: &[PointId]) -> Option<[f64; 2]> {
        let mechanism = &self.case.mechanism;
        let pivot = others.iter().find(|other| mechanism.is_fixed(**other))?;
        let space = &self.construction.space;
        let arm = difference(space.places[point.0]?, space.places[pivot.0]?);
        let of = |link: &LinkId| mechanism.link(*link).points.contains(&point);
        let (_, omega) = self.omegas().into_iter().find(|(link, _)| of(link))?;
        let mm = -omega * omega * space.metres_per_mm / self.case.si_per_mm(Order::Acceleration);
        Some(arm.map(|part| part * mm))
    }

    /// The image of a point at the distance of the point along the line of two others of its link: of one that does not lie
    /// there by forgetting that, of one that lies beyond them from the other end.
    fn taken_on_the_line(&mut self) {
        let mechanism = &self.case.mechanism;
        let place = |point: PointId| self.construction.space.places.get(point.0).copied().flatten();
        let mut found: Vec<(Kind, PointId, PointId, Vec<Departure>)> = Vec::new();
        for link in mechanism.moving() {
            let points = &mechanism.link(link).points;
            for &point in points.iter().filter(|point| !mechanism.is_fixed(**point)) {
                let others: Vec<PointId> = points.iter().copied().filter(|other| *other != point).collect();
                let &[one, two] = &others[..] else { continue };
                let (Some(a), Some(b), Some(own)) = (place(one), place(two), place(point)) else { continue };
                let [base, far] = [difference(b, a), difference(own, a)];
                let sine = (base[0] * far[1] - base[1] * far[0]) / size(&base) / size(&far);
                let bent = sine.abs() > ON_LINE;
                for (from, to, arm) in [(one, two, far), (two, one, difference(own, b))] {
                    let other = if bent { arm } else { difference(own, place(to).unwrap_or(own)) };
                    let part = size(&other) / size(&base);
                    let departures = self.at_part([from, to], point, part);
                    let kind = if bent { Kind::ImageOnLine } else { Kind::ProportionFromOtherEnd };
                    if part.is_finite() && !departures.is_empty() {
                        found.push((kind, point, from, departures));
                    }
                }
            }
        }
        for (kind, point, from, departures) in found {
            let at = match kind {
                Kind::ImageOnLine => say!("the image of {}", self.case.mechanism.point(point).name),
                _ => Phrase::from(&self.case.mechanism.point(point).name),
            };
            let how = say!("from {}", self.case.mechanism.point(from).name);
            for departure in &departures {
                let change = Change::drawn(vec![*departure]);
                self.add_so((kind, how.clone()), &at, None, 0.75, change);
            }
            self.add_so((kind, how), &at, None, 0.25, Change::drawn(departures));
        }
    }

    /// The image of a point at a part of the way between those of two others, in every polygon.
    fn at_part(&self, [from, to]: [PointId; 2], point: PointId, part: f64) -> Vec<Departure> {
        let departure = |order: Order| {
            let images = &polygon(self.construction, order)?.images;
            let at = |of: PointId| {
                let fixed = self.case.mechanism.is_fixed(of).then_some([0.0; 2]);
                let own = Label::Image { point: of, link: None };
                fixed.or_else(|| images.iter().rev().find(|image| image.label == own).map(|image| image.at))
            };
            // Only where the point has an image at all.
            at(point)?;
            let [a, b] = [at(from)?, at(to)?];
            let at = [0, 1].map(|axis| a[axis] + part * (b[axis] - a[axis]));
            Some(Departure::Image { order, point, at })
        };
        [Order::Velocity, Order::Acceleration].into_iter().filter_map(departure).collect()
    }

    fn images(&mut self) {
        self.divided_off();
        self.taken_on_the_line();
        self.laid_off_from_other_end();
        let mut further: Vec<(LinkId, PointId)> = Vec::new();
        let moving = |diagram: &&DiagramPlan| diagram.kind != DiagramKind::Skeleton;
        for step in self.case.plan.diagrams.iter().filter(moving).flat_map(|diagram| &diagram.steps) {
            further.extend(&step.points);
        }
        further.sort_unstable();
        further.dedup();
        for (link, point) in further {
            let others = &self.case.mechanism.link(link).points;
            let others: Vec<PointId> = others.iter().copied().filter(|p| *p != point).collect();
            self.image_taken_otherwise(point, &others);
            // From a fixed point it is the vector itself that has the opposite sense.
            for &from in others.iter().filter(|p| !self.case.mechanism.is_fixed(**p)) {
                let relative = [
                    (Order::Velocity, self.name(&Quantity::RelativeVelocity(point, from))),
                    (Order::Acceleration, self.name(&Quantity::RelativeAcceleration(point, from))),
                ];
                for (order, at) in relative {
                    let backwards = Departure::Backwards { order, point, from };
                    self.add(Kind::RelativeReversed, &at, None, PLAIN, Change::drawn(vec![backwards]));
                    // Nothing follows from where the point went.
                    let image = polygon(self.construction, order)
                        .and_then(|polygon| polygon.image_of(from, &self.case.mechanism));
                    let of = match order {
                        Order::Acceleration => Quantity::Acceleration(point),
                        _ => Quantity::Velocity(point),
                    };
                    if let Some(image) = image {
                        let read = Change::read(Misreading::Backwards { of, from: image.label });
                        self.add(Kind::RelativeReversed, &at, None, 0.5, read);
                    }
                }
            }
            for (index, &first) in others.iter().enumerate() {
                for &second in &others[index + 1..] {
                    let mirrored = |order| Departure::Mirrored { order, point, about: [first, second] };
                    let at = say!("the image of link {}", self.number(link));
                    let both = vec![mirrored(Order::Velocity), mirrored(Order::Acceleration)];
                    self.add(Kind::ImageMirrored, &at, None, PLAIN, Change::drawn(both));
                    for order in [Order::Velocity, Order::Acceleration] {
                        let change = Change::drawn(vec![mirrored(order)]);
                        self.add(Kind::ImageMirrored, &at, None, PLAIN, change);
                    }
                }
            }
        }
    }

    // --- readings ------------------------------------------------------------------------------

    /// A sense that was written down wrongly.
    fn readings(&mut self) {
        let twist = Twist::scaled(-1.0);
        for quantity in self.observed() {
            let relative = matches!(
                quantity,
                Quantity::RelativeVelocity(..)
                    | Quantity::RelativeAcceleration(..)
                    | Quantity::RelativeOmega(..)
                    | Quantity::RelativeAlpha(..)
                    | Quantity::Slip(..)
                    | Quantity::SlipAcceleration(..)
                    | Quantity::RelativeNormal(..)
                    | Quantity::RelativeTangential(..)
            );
            let name = self.name(&quantity);
            let reading = || Change::read(Misreading::Twisted { of: Which::One(quantity), twist });
            let (first, second) = match quantity {
                Quantity::RelativeNormal(..) | Quantity::Normal(_) | Quantity::CoincidentNormal(..) => {
                    (Kind::NormalAwayFromCentre, Kind::SenseReversed)
                }
                Quantity::Coriolis(..) => (Kind::CoriolisWrongTurn, Kind::SenseReversed),
                Quantity::Force(force, _) => (reversed(force), Kind::SenseReversed),
                _ if relative => (Kind::RelativeReversed, Kind::SenseReversed),
                _ => (Kind::SenseReversed, Kind::SenseReversed),
            };
            self.add(first, &name, None, PLAIN, reading());
            if second != first {
                self.add(second, &name, None, UNUSUAL, reading());
            }
            if relative && quantity.order() == Order::Velocity {
                // What is calculated from it has the other sense as well.
                let departure = Departure::Read { quantity, factor: -1.0 };
                let change = reading().and(&Change::drawn(vec![departure]));
                self.add(Kind::RelativeReversed, &name, None, PLAIN, change);
            }
        }
    }

    /// Scale factors forgotten or inverted: of one answer, of a polygon, of all.
    fn scales(&mut self) {
        let figures = self.whole_figures().into_iter();
        let mut scopes: Vec<(Which, Phrase, f64)> = figures
            .map(|(of, _, at)| (of, at, PLAIN))
            .chain([(Which::AllVectors, say!("every reading"), 1.0)])
            .collect();
        for quantity in self.read() {
            if super::answers::is_vector(&quantity) {
                // A reading that nobody sees is the less likely one, and what is calculated is not read.
                let seen = self.observed().contains(&quantity);
                let read = self.case.includes(Which::Read(quantity.order()), &quantity);
                let price = if seen && read { PLAIN } else { UNSEEN };
                scopes.push((Which::One(quantity), self.name(&quantity).into(), price));
            }
        }
        for (of, at, price) in scopes {
            for (factor, more) in [(1.0, 0.0), (0.1, 0.5)] {
                let forgotten = Change::read(Misreading::Unscaled { of, factor });
                self.add(Kind::ScaleForgotten, &at, None, price + more, forgotten.clone());
                let by = |mm: f64| mm * factor;
                self.follow((Kind::ScaleForgotten, of), &at, price + more, &forgotten, &by);
            }
            // Where the scale is not stated, it may be another round one.
            if let (Which::One(quantity), false) = (of, self.case.states_scale(of)) {
                // The right digits in another unit are no length on paper.
                let digits = |other: &f64| {
                    let power = libm::log10(other * self.case.answer_on_paper(&quantity));
                    (power - libm::round(power)).abs() < SAME_LENGTH
                };
                let others: Vec<f64> = OTHER_SCALES.into_iter().filter(|other| !digits(other)).collect();
                for other in others {
                    let forgotten =
                        Change::read(Misreading::Unscaled { of: Which::One(quantity), factor: other });
                    self.add(Kind::ScaleForgotten, &at, None, price + UNUSUAL, forgotten);
                }
            }
            // Millimetres over units per millimetre; the same in centimetres; and mixed.
            for (factor, more) in [(1.0, 0.0), (0.01, 0.0), (0.1, 1.0)] {
                let inverted = Change::read(Misreading::Divided { of, factor });
                self.add(Kind::ScaleInverted, &at, None, price + more, inverted.clone());
                let by = |mm: f64| mm * mm * factor;
                self.follow((Kind::ScaleInverted, of), &at, price + more, &inverted, &by);
            }
            // Once more, by millimetres or by centimetres.
            for (factor, more) in [(1.0, 0.0), (10.0, 0.0)] {
                // By one vector alone any round factor would be told so.
                let more = if matches!(of, Which::One(_)) { more + FAR } else { more };
                let twice = Change::read(Misreading::ScaledTwice { of, factor });
                self.add(Kind::ScaleTwice, &at, None, price + more, twice.clone());
                let by = |mm: f64| factor / mm;
                self.follow((Kind::ScaleTwice, of), &at, price + more, &twice, &by);
            }
        }
    }

    /// The same, and what was calculated from the misread lengths; `by` tells the factor from how many millimetres a unit of
    /// the answer is long.
    fn follow(
        &mut self,
        (kind, of): (Kind, Which),
        at: &Phrase,
        price: f64,
        read: &Change,
        by: &dyn Fn(f64) -> f64,
    ) {
        let units = &self.case.scene.units;
        let factor_of = |order: Order| {
            let time =
                if order == Order::Acceleration { units.time.si * units.time.si } else { units.time.si };
            by(units.length.si / time / self.case.si_per_mm(order))
        };
        let departures = match of {
            Which::One(quantity) => {
                vec![Departure::Read { quantity, factor: factor_of(quantity.order()) }]
            }
            Which::Vectors(order) | Which::Read(order) | Which::Found(order) | Which::Measured(order) => {
                vec![Departure::ReadAll { order, factor: factor_of(order) }]
            }
            Which::AllVectors | Which::AllLinear | Which::Omegas => [Order::Velocity, Order::Acceleration]
                .map(|order| Departure::ReadAll { order, factor: factor_of(order) })
                .to_vec(),
        };
        self.add(kind, at, None, price + 0.5, read.and(&Change::drawn(departures)));
        // Further points by the image: nothing follows from the rates that were calculated.
        let rates = self.rates_from(of).into_iter().map(|(order, rate)| Misreading::Twisted {
            of: Which::One(rate),
            twist: Twist::scaled(factor_of(order)),
        });
        let readings: Vec<Misreading> = rates.collect();
        if !readings.is_empty() {
            let change = Change { readings, ..Change::default() };
            self.add(kind, at, None, price + 1.0, read.and(&change));
        }
    }

    /// The rates that are calculated from vectors, with the polygon of these.
    fn rates_from(&self, of: Which) -> Vec<(Order, Quantity)> {
        let rate = |(_, act): (usize, &Act)| match *act {
            Act::Calculate(Calculation::Omega { link, quantity, .. })
                if self.case.includes(of, &quantity) =>
            {
                Some((Order::Velocity, Quantity::Omega(link)))
            }
            Act::Calculate(Calculation::Alpha { link, quantity, .. })
                if self.case.includes(of, &quantity) =>
            {
                Some((Order::Acceleration, Quantity::Alpha(link)))
            }
            _ => None,
        };
        self.acts().into_iter().filter_map(rate).collect()
    }

    /// A polygon that the student drew turned against the skeleton.
    fn figures_turned(&mut self) {
        let polygons = [
            (Order::Velocity, say!("the velocity polygon")),
            (Order::Acceleration, say!("the acceleration polygon")),
        ];
        for (order, at) in polygons {
            let Some(by) = self.case.turns.against_sheet(order) else { continue };
            let degrees = format!("{:.0}", by.abs().to_degrees());
            let how = match by < 0.0 {
                true => say!("by {}° clockwise", degrees),
                false => say!("by {}° counter-clockwise", degrees),
            };
            let read = Change::read(Misreading::Turned { order, by });
            self.add_so((Kind::FigureTurned, how), at, None, 1.0, read);
        }
    }

    /// Vectors measured from another point of the polygon.
    fn poles(&mut self, so_far: &Sketch) {
        for quantity in self.read() {
            let order = quantity.order();
            let usual = matches!(
                quantity,
                Quantity::Velocity(_)
                    | Quantity::RelativeVelocity(..)
                    | Quantity::Acceleration(_)
                    | Quantity::RelativeAcceleration(..)
                    | Quantity::CoincidentVelocity(..)
                    | Quantity::CoincidentAcceleration(..)
                    | Quantity::Slip(..)
                    | Quantity::Tangential(_)
                    | Quantity::RelativeTangential(..)
                    | Quantity::CoincidentTangential(..)
            );
            let Some(polygon) = polygon(&so_far.construction, order).filter(|_| usual) else { continue };
            let Some(vector) = polygon.vectors.iter().find(|v| v.quantity == quantity).copied() else {
                continue;
            };
            let mut tails: Vec<(Label, [f64; 2])> = vec![(Label::Pole, [0.0; 2])];
            tails.extend(polygon.images.iter().map(|image| (image.label, image.at)));
            let name = self.name(&quantity);
            let step = Some(vector.step);
            let mut tried: Vec<[f64; 2]> = vec![vector.from, vector.to];
            for (label, tail) in tails {
                if tried.iter().any(|t| size(&difference(*t, tail)) < 1.0) {
                    continue;
                }
                tried.push(tail);
                let read = difference(vector.to, tail);
                let factor = self.read_factor(&quantity, read, difference(vector.to, vector.from));
                let from_there = Misreading::MeasuredFrom { of: quantity, tail: label };
                let how = self.read_for([label, vector.head], &vector, order);
                self.add_so((Kind::WrongPole, how.clone()), &name, step, 0.5, Change::read(from_there));
                if let Some(factor) = factor {
                    let departure = Departure::Read { quantity, factor };
                    let change = Change {
                        departures: vec![departure],
                        readings: vec![from_there],
                        ..Change::default()
                    };
                    self.add_so((Kind::WrongPole, how), &name, step, 1.0, change);
                }
            }
            let price = 0.5 + one_of(tried.len()) / 2.0;
            let heads: Vec<(Label, [f64; 2])> =
                polygon.images.iter().map(|image| (image.label, image.at)).collect();
            let mut tried: Vec<[f64; 2]> = vec![vector.from, vector.to];
            for (label, head) in heads {
                if tried.iter().any(|t| size(&difference(*t, head)) < 1.0) {
                    continue;
                }
                tried.push(head);
                let to_there = Misreading::MeasuredTo { of: quantity, head: label };
                let how = self.read_for([vector.tail, label], &vector, order);
                let kind = || (Kind::NeighbourRead, how.clone());
                self.add_so(kind(), &name, step, price, Change::read(to_there));
                let read = difference(head, vector.from);
                if let Some(factor) = self.read_factor(&quantity, read, difference(vector.to, vector.from)) {
                    let departure = Departure::Read { quantity, factor };
                    let change =
                        Change { departures: vec![departure], readings: vec![to_there], ..Change::default() };
                    self.add_so(kind(), &name, step, price + 0.5, change);
                }
            }
        }
    }

    /// By which factor a vector is misread of which another one was measured: its size, and the other sense where it lies on the
    /// other side of the link that is turned by it. None of a vector that is nothing.
    fn read_factor(&self, quantity: &Quantity, read: [f64; 2], own: [f64; 2]) -> Option<f64> {
        let factor = size(&read) / size(&own);
        let turns = self.acts().into_iter().any(|(_, act)| {
            matches!(act, Act::Calculate(Calculation::Omega { quantity: of, .. } | Calculation::Alpha { quantity: of, .. }) if of == quantity)
        });
        // Along the link it turns it neither way: the sense is that of the right vector then.
        let side = (read[0] * own[0] + read[1] * own[1]) / (size(&read) * size(&own));
        factor.is_finite().then_some(if turns && side < -ALONG { -factor } else { factor })
    }

    /// "bc read for oc".
    fn read_for(&self, [tail, head]: [Label; 2], vector: &Vector, order: Order) -> Phrase {
        let sheet = &self.case.right.construction;
        let name = |label| crate::sheet::image_symbol(self.case.scene, sheet, label, order.diagram()).plain;
        say!("{} read for {}", name(tail) + &name(head), name(vector.tail) + &name(vector.head))
    }

    // --- what stands in the construction -------------------------------------------------------

    fn acts(&self) -> Vec<(usize, &'c Act)> {
        let construction: &'c Construction = self.construction;
        let steps = construction.steps.iter().enumerate();
        steps.flat_map(|(number, step)| step.acts.iter().map(move |act| (number, act))).collect()
    }

    /// The quantities that were answered by value.
    pub(super) fn observed(&self) -> Vec<Quantity> {
        self.case
            .observations
            .iter()
            .filter(|o| !matches!(o.target, Target::Image(..) | Target::Place(_)))
            .filter_map(|o| o.quantity)
            .collect()
    }

    /// The same, and those from which something is calculated.
    fn read(&self) -> Vec<Quantity> {
        let mut read = self.observed();
        for (_, act) in self.acts() {
            let quantity = match *act {
                Act::Calculate(Calculation::Omega { quantity, .. } | Calculation::Alpha { quantity, .. }) => {
                    quantity
                }
                Act::Calculate(Calculation::Normal { velocity, .. }) => velocity,
                Act::Calculate(Calculation::Coriolis { slip, .. } | Calculation::SlipNormal { slip, .. }) => {
                    slip
                }
                _ => continue,
            };
            if !read.contains(&quantity) {
                read.push(quantity);
            }
        }
        read
    }

    fn driven(&self) -> Vec<LinkId> {
        let inputs = self.case.mechanism.inputs.iter();
        inputs
            .filter_map(|input| match *input {
                Input::Angle { link, .. } | Input::Speed { link, .. } => Some(link),
                Input::Slide { .. } => None,
            })
            .collect()
    }

    fn calculated_rates(&self) -> Vec<(Order, LinkId, usize)> {
        let rate = |(step, act): (usize, &Act)| match *act {
            Act::Calculate(Calculation::Omega { link, .. }) => Some((Order::Velocity, link, step)),
            Act::Calculate(Calculation::Alpha { link, .. }) => Some((Order::Acceleration, link, step)),
            _ => None,
        };
        self.acts().into_iter().filter_map(rate).collect()
    }

    /// ω of every link of which one is calculated or given.
    fn omegas(&self) -> Vec<(LinkId, f64)> {
        let mut omegas: Vec<(LinkId, f64)> = Vec::new();
        for (_, act) in self.acts() {
            let found = match *act {
                Act::Calculate(Calculation::Omega { link, value, .. }) => (link, value),
                Act::Calculate(Calculation::Speed { link, omega, .. }) => (link, omega),
                _ => continue,
            };
            if !omegas.iter().any(|(link, _)| *link == found.0) {
                omegas.push(found);
            }
        }
        for input in &self.case.mechanism.inputs {
            if let Input::Angle { link, omega, .. } = *input
                && !omegas.iter().any(|(known, _)| *known == link)
            {
                omegas.push((link, omega.value));
            }
        }
        omegas
    }

    /// ε of every link of which one is calculated or given.
    fn alphas(&self) -> Vec<(LinkId, f64)> {
        let calculated = self.acts().into_iter().filter_map(|(_, act)| match *act {
            Act::Calculate(Calculation::Alpha { link, value, .. }) => Some((link, value)),
            Act::Calculate(Calculation::Tangential { link, alpha, .. }) => Some((link, alpha)),
            _ => None,
        });
        let given = self.case.mechanism.inputs.iter().filter_map(|input| match *input {
            Input::Angle { link, alpha, .. } => Some((link, alpha.value)),
            Input::Speed { .. } | Input::Slide { .. } => None,
        });
        given.chain(calculated).collect()
    }

    /// Every link with its ω, by the length with which it was calculated.
    fn turning(&self) -> Vec<Turning> {
        let mut turning: Vec<Turning> = Vec::new();
        for (_, act) in self.acts() {
            let (link, omega, length, ends) = match *act {
                Act::Calculate(Calculation::Omega { link, value, length, ends, .. }) => {
                    (link, value, length, ends)
                }
                Act::Calculate(Calculation::Speed { link, omega, length, ends, .. }) => {
                    (link, omega, length, ends)
                }
                _ => continue,
            };
            let known = turning.iter().any(|t| t.link == link && (t.length - length).abs() <= 1e-9 * length);
            if let (Some(angle), false) = (self.angle(ends), known) {
                turning.push(Turning { link, omega, length, angle });
            }
        }
        turning
    }

    /// The lengths between any two points of a link.
    pub(super) fn lengths(&self) -> Vec<f64> {
        let mut lengths: Vec<f64> = Vec::new();
        let mechanism = &self.case.mechanism;
        for (_, act) in self.acts() {
            if let Act::Calculate(
                Calculation::Omega { length, .. }
                | Calculation::Speed { length, .. }
                | Calculation::Normal { length, .. }
                | Calculation::Tangential { length, .. }
                | Calculation::Alpha { length, .. },
            ) = *act
                && !lengths.iter().any(|l| (l - length).abs() <= SAME_LENGTH * length)
            {
                lengths.push(length);
            }
        }
        for link in mechanism.moving() {
            let points = &mechanism.link(link).points;
            for (index, &p) in points.iter().enumerate() {
                for &q in &points[index + 1..] {
                    let places = &self.construction.space.places;
                    let (Some(a), Some(b)) = (places[p.0], places[q.0]) else { continue };
                    let length = size(&difference(a, b)) * self.construction.space.metres_per_mm;
                    let known = lengths.iter().any(|l| (l - length).abs() <= SAME_LENGTH * length);
                    if length > 0.0 && !known {
                        lengths.push(length);
                    }
                }
            }
        }
        lengths
    }

    fn angle(&self, [from, to]: [PointId; 2]) -> Option<f64> {
        let places = &self.construction.space.places;
        let [x, y] = difference(places[to.0]?, places[from.0]?);
        Some(libm::atan2(y, x))
    }

    /// The link of a normal part: that under the point, or the one of which its ends are points.
    fn link_of(&self, normal: &Quantity, [a, b]: [PointId; 2]) -> LinkId {
        if let Quantity::CoincidentNormal(_, link) = *normal {
            return link;
        }
        let mechanism = &self.case.mechanism;
        let both = |link: &LinkId| [a, b].iter().all(|p| mechanism.link(*link).points.contains(p));
        mechanism.moving().find(both).unwrap_or(LinkId::FRAME)
    }
}

/// Whether a number is one in which no length of the scene is written.
fn of_forces(quantity: &Quantity) -> bool {
    match quantity {
        Quantity::Force(force, _) => !matches!(force, Force::Offset(_) | Force::Arm(..) | Force::Moment(..)),
        Quantity::Cycle(_) => true,
        _ => false,
    }
}

/// What it is that has the opposite sense.
fn reversed(force: Force) -> Kind {
    match force {
        Force::Vector(Action::Pair { .. } | Action::OfPin(..) | Action::OnPin(..))
        | Force::Along { .. }
        | Force::Across { .. } => Kind::ReactionForAction,
        Force::Vector(Action::Inertia(_)) => Kind::InertiaAlongAcceleration,
        Force::InertiaTorque(_) => Kind::CoupleWithAlpha,
        Force::Torque(_) | Force::Drive(_) => Kind::TorqueGiven,
        _ => Kind::SenseReversed,
    }
}

/// Whether two directions are clear of each other, whichever way each is followed.
pub(super) fn apart(a: [f64; 2], b: [f64; 2]) -> bool {
    sine(a, b) > 0.07
}

/// By how much two directions differ, whichever way each is followed.
fn sine(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] * b[1] - a[1] * b[0]).abs()
}

/// Two lines of a skeleton that differ by less lead to one place.
const TOLD_APART: f64 = 0.01;

/// A vector whose part across a link is smaller than this part of it is taken to lie along the link.
const ALONG: f64 = 0.15;
/// Two factors of one scale that are read off a drawing differ by less than this part.
const ONE_SCALE: f64 = 0.06;

/// A scale in millimetres or centimetres that is one of its round neighbours.
const OTHER_SCALES: [f64; 8] = [0.5, 0.4, 2.0, 2.5, 0.05, 0.04, 0.2, 0.25];

/// The price of one of several that would do as well: the more there are, the sooner one fits by chance.
pub(super) fn one_of(count: usize) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "links and lengths are few")]
    let count = count.max(1) as f64;
    2.0 * libm::log(count)
}

/// A point whose direction from another one differs by no more (its sine) lies on the line.
const ON_LINE: f64 = 1e-6;

/// An angle as people write it.
fn degrees_of(angle: f64) -> String {
    format!("{}°", super::text::digits(angle.to_degrees().abs(), 0.1))
}

/// Two lengths that differ by less than this part are one.
const SAME_LENGTH: f64 = 1e-6;

/// The lengths that are not this one.
fn others(lengths: &[f64], length: f64) -> impl Iterator<Item = f64> {
    lengths.iter().copied().filter(move |other| (other - length).abs() > SAME_LENGTH * length)
}

fn difference(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

/// The vectors of a construction that represent a quantity.
pub(super) fn vector_of<'c>(construction: &'c Construction, quantity: &Quantity) -> Option<&'c Vector> {
    polygon(construction, quantity.order())?.vectors.iter().find(|v| v.quantity == *quantity)
}
