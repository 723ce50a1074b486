//! A governor as it is told: the sleeve along its guide, moments of the arm, M ω² r and the speed.

use std::f64::consts::TAU;

use kurbo::{Point, Vec2};

use super::figure::{Group, Mark, Pen, Shape};
use super::forces::on_page;
use super::human;
use super::ink::{FINE, SMALL, head};
use super::labels::{Request, Site};
use super::notation::Notation;
use super::printed::Key;
use super::rich::Rich;
use super::statics::{DOT, EQUALS, Factor, OVER, TIMES, Teller, arm_name, as_measured, product};
use super::steps::{Item, in_radians};
use crate::graphical::construction::{
    About, AlongGuide, Arm, Construction, ForceSheet, Governor, GovernorState, MomentBalance, OnSleeve,
};
use crate::mechanism::force::{Action, Force, Heaviness, Party, Share};
use crate::mechanism::quantity::{Order, Quantity, Unit};
use crate::mechanism::spin::SpinSpeed;

/// Turns in a minute.
pub(super) fn rpm() -> Unit {
    Unit { symbol: "rpm".to_owned(), si: TAU / 60.0 }
}

/// Radians in a second.
fn radians() -> Unit {
    Unit { symbol: "rad/s".to_owned(), si: 1.0 }
}

/// The distance of the ball from the axis.
fn radius_name(governor: &Governor, notation: &Notation<'_>) -> Rich {
    Rich::italic("r").sub(&notation.number(governor.link))
}

/// Whether the size of what is found on a body is told by lines of arithmetic, and no polygon of it is drawn: a sleeve on
/// which everything acts along its guide, an arm of whose joint only a part is known.
pub(super) fn without_polygon(sheet: &ForceSheet, index: usize) -> bool {
    let Some(governor) = &sheet.governor else { return false };
    let Some(state) = governor.states.first() else { return false };
    if governor.arm == index {
        return !governor.closes || matches!(state.moments.about, About::Centre { .. });
    }
    governor.sleeve == Some(index) && state.along.as_ref().is_some_and(|along| !along.inclined)
}

/// The axis of rotation through a place as a chain line, past all that hangs on it.
pub(super) fn axis(on: Point, along: Vec2, construction: &Construction) -> Group {
    /// How far the axis runs past what hangs on it, mm.
    const PAST: f64 = 6.0;
    let places = construction.space.places.iter().flatten();
    let reach = places.map(|at| (super::ink::page(*at) - on).dot(along));
    let ends = reach.fold(None, |ends: Option<(f64, f64)>, at| {
        let (least, most) = ends.unwrap_or((at, at));
        Some((least.min(at), most.max(at)))
    });
    let mut own = Group::new("axis");
    if let Some((least, most)) = ends {
        let line = Shape::Line(on + along * (least - PAST), on + along * (most + PAST));
        own.mark(Mark::stroke(line, Pen::chain(FINE)));
    }
    own
}

/// The distance of the ball from the axis, and the axis, on the skeleton.
pub(super) fn radius(
    group: &mut Group,
    requests: &mut Vec<Request>,
    governor: &Governor,
    construction: &Construction,
    notation: &Notation<'_>,
) {
    /// How far beside the ball its distance is dimensioned, mm.
    const ASIDE: f64 = 6.0;
    let [foot, ball] = [governor.foot, governor.ball].map(|place| on_page(place, construction));
    let Some(spin) = &notation.mechanism().forces.spin else { return };
    let (sin, cos) = libm::sincos(spin.angle.value);
    let along = Vec2::new(cos, -sin);
    let reach =
        construction.space.places.iter().flatten().map(|at| (super::ink::page(*at) - foot).dot(along));
    let (least, most) = reach.fold((0.0_f64, 0.0_f64), |(least, most), at| (least.min(at), most.max(at)));
    group.group(axis(foot, along, construction));
    if foot.distance(ball) < 4.0 {
        return;
    }
    // Beside the ball, on the side where less of the skeleton is.
    let out = (ball - foot).normalize();
    let aside = if most > -least { -along } else { along } * ASIDE;
    let (from, to) = (foot + aside, ball + aside);
    let mut own =
        Group::new("arm").data("value", format!("{}", governor.radius / notation.scene.units.length.si));
    own.mark(Mark::stroke(Shape::Line(ball + aside * 0.3, to + aside * 0.25), Pen::solid(FINE)));
    own.mark(Mark::stroke(Shape::Line(from, to), Pen::solid(FINE)).precise());
    own.mark(head(to, out, 2.0));
    own.mark(head(from, -out, 2.0));
    group.group(own);
    let (foot, ball) = (from, to);
    let name = radius_name(governor, notation);
    let mut request = Request::new(name, SMALL, Site::Along { from: foot, to: ball }, "label arm-name");
    request.leader = true;
    requests.push(request);
}

impl Teller<'_> {
    /// What is told of a governor before its bodies: the speed and M ω² r where they are given, the distance of the ball.
    pub(super) fn governor_given(&self, governor: &Governor) -> Vec<Rich> {
        let mut lines = Vec::new();
        let units = &self.n.scene.units;
        let Some(spin) = &self.n.mechanism().forces.spin else { return lines };
        let idle = spin
            .sleeve
            .filter(|sleeve| !self.sheet.bodies.iter().any(|body| body.of == Party::Link(*sleeve)));
        if let Some(sleeve) = idle {
            let [sleeve, arm] = [sleeve, governor.link].map(|link| Rich::upright(self.n.number(link)));
            lines.push(Rich::fill(self.n.words.governor_idle, &[("sleeve", sleeve), ("arm", arm)]));
        } else if spin.balls > 1 {
            let count = ("count", human::stated(f64::from(spin.balls)));
            lines.push(Rich::fill(self.n.words.governor_halves, &[count]));
        }
        if let (SpinSpeed::Given(omega), Some(stated)) = (spin.omega, &self.n.scene.spin_unit) {
            let key = Key::Given("spin");
            let symbol = Rich::italic("ω");
            lines.extend(in_radians(
                symbol,
                (omega.value, stated),
                key,
                self.n,
                self.figures,
                Order::Velocity,
            ));
        }
        let mm = governor.radius / self.construction.space.metres_per_mm;
        let key = Key::Given("radius");
        let (reading, length) = self.measured(key, governor.radius, mm);
        let measured = as_measured(radius_name(governor, self.n), &reading, &length);
        lines.push(Rich::fill(self.n.words.measured_arms, &[("list", measured)]));
        if let Some(mass) = self.n.mechanism().forces.mass(governor.link)
            && let Heaviness::Weight(weight) = mass.heaviness
        {
            lines.push(self.mass_of_weight(governor.link, weight.value, governor.mass));
        }
        if let (false, Some(state)) = (governor.sought, governor.states.first()) {
            let rad = radians();
            let factors = [
                Factor::new(governor.mass, &units.mass, "kg").of(Key::OfLink("M", governor.link)),
                Factor::new(state.omega, &rad, "rad/s").of(Key::Given("spin")),
                Factor::new(governor.radius, &units.length, "m").of(key),
            ];
            let result = Factor::new(state.centrifugal, &units.force, "N")
                .of(self.whole(Force::Vector(Action::Centrifugal(governor.link))));
            let formula = self.mass_name(governor).up(DOT).it("ω").up("²").up(DOT);
            let formula = formula.then(&radius_name(governor, self.n));
            let set = |n: &[Rich]| n[0].clone().up(TIMES).up("(").then(&n[1]).up(")²").up(TIMES).then(&n[2]);
            let of = self.symbol(Action::Centrifugal(governor.link));
            lines.push(self.line(of, formula, &factors, set, |n| n[0] * n[1] * n[1] * n[2], result));
        }
        lines
    }

    fn mass_name(&self, governor: &Governor) -> Rich {
        Rich::italic("M").sub(&self.n.number(governor.link))
    }

    /// In which sense the sleeve is about to move, where something drags on it.
    fn about_to_move(&self, state: &GovernorState) -> Option<Rich> {
        let mechanism = self.n.mechanism();
        let spin = mechanism.forces.spin?;
        let drag = spin.drag?;
        let sense = spin.sense(state.share, mechanism)?;
        let along = state.along.as_ref()?.angle;
        let angle = if sense > 0.0 { along } else { along + std::f64::consts::PI };
        let angle = libm::remainder(angle, TAU);
        let parts = [
            ("drag", self.symbol(Action::Drag(drag.slide))),
            ("angle", Rich::upright("∠\u{a0}").then(&human::degrees(angle))),
        ];
        let words = self.n.words;
        let template = if sense > 0.0 { words.governor_rising } else { words.governor_falling };
        Some(Rich::fill(template, &parts))
    }

    /// What is told at a body of a governor beside its table: of the sleeve what acts along its guide, of the arm its moments
    /// and the speed. Of the sense that is drawn before the polygon, of the other one after it.
    pub(super) fn governor_body(&self, index: usize, after: bool) -> Vec<Item> {
        let Some(governor) = &self.sheet.governor else { return Vec::new() };
        let mut lines: Vec<Rich> = Vec::new();
        let first = self.sheet.share;
        for state in governor.states.iter().filter(|state| (state.share != first) == after) {
            let teller = Self { share: state.share, several: governor.states.len() > 1, ..*self };
            let mut own = Vec::new();
            if governor.sleeve == Some(index)
                && let Some(along) = &state.along
            {
                own.extend(self.about_to_move(state));
                own.extend(teller.along_guide(along, governor, state.share == first));
                own.extend(self.couple_of_sleeve(index).filter(|_| state.share == first));
            }
            if governor.arm == index {
                own.extend(teller.of_arm(governor, state, state.share == first));
            }
            lines.extend(own);
        }
        if governor.arm == index && !after {
            lines.extend(self.one_speed(governor));
        }
        lines.into_iter().map(Item::Sentence).collect()
    }

    /// That a sleeve on which nothing rubs rises and falls at the speed at which it rests.
    fn one_speed(&self, governor: &Governor) -> Option<Rich> {
        let asked = self.n.mechanism().asked.iter().filter_map(|asked| match asked.quantity {
            Quantity::Force(Force::Spin, share @ (Share::Rising | Share::Falling)) => Some(share),
            _ => None,
        });
        let forces = &self.n.mechanism().forces;
        let rubs = forces.spin.is_some_and(|spin| spin.drag.is_some()) || !forces.friction.is_empty();
        let others: Vec<Share> = asked.filter(|_| governor.states.len() == 1 && !rubs).collect();
        let own = self.whole(Force::Spin);
        let named = |share: Share| self.n.symbol(Quantity::Force(Force::Spin, share), false);
        for share in &others {
            self.figures.borrow_mut().alias(Key::Of(Quantity::Force(Force::Spin, *share)), own);
        }
        let names: Vec<Rich> =
            others.iter().map(|share| named(*share)).chain([named(Share::Total)]).collect();
        (names.len() > 1).then(|| Rich::join(&names, &Rich::upright(EQUALS)).up("."))
    }

    /// That the guide holds a sleeve whose forces do not pass through one point.
    fn couple_of_sleeve(&self, index: usize) -> Option<Rich> {
        /// A couple that is a smaller part of the moments is their rounding.
        const NONE: f64 = 1e-6;
        let acting = &self.sheet.bodies.get(index)?.acting;
        let [x, y] = acting.first()?.through;
        let moments: Vec<f64> = acting
            .iter()
            .map(|own| (own.through[0] - x) * own.force[1] - (own.through[1] - y) * own.force[0])
            .collect();
        let (sum, size) = moments.iter().fold((0.0, 0.0), |(sum, size), own| (sum + own, size + own.abs()));
        (sum.abs() > NONE * f64::max(size, f64::MIN_POSITIVE))
            .then(|| Rich::upright(self.n.words.governor_couple))
    }

    /// The size of what is found on the sleeve.
    fn along_guide(&self, along: &AlongGuide, governor: &Governor, first: bool) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let (found, size, partly) = along.found;
        let part = |action: Action, partly: bool| match partly {
            true => self.part(action),
            false => self.symbol(action),
        };
        let key = |action: Action, partly: bool| match partly {
            true => self.part_key(action),
            false => self.whole(Force::Vector(action)),
        };
        if along.inclined {
            return self.by_similar_triangle(along, governor, first);
        }
        let mut terms: Vec<&OnSleeve> = along.terms.iter().collect();
        terms.sort_by_key(|(.., against)| !*against);
        let signs = |each: &dyn Fn(usize, &OnSleeve) -> Rich| {
            let mut all = Rich::default();
            for (i, term) in terms.iter().enumerate() {
                let sign = match (i, term.3) {
                    (0, true) => "",
                    (0, false) => "−",
                    (_, true) => " + ",
                    (_, false) => " − ",
                };
                all = all.up(sign).then(&each(i, term));
            }
            all
        };
        let halves = |action: Action| self.n.mechanism().halves_of(action);
        let factors: Vec<Factor<'_>> = terms
            .iter()
            .map(|(action, size, partly, _)| {
                let whole = size * halves(*action);
                let factor = Factor::new(whole, &units.force, "N");
                match action {
                    Action::Weight(link) => factor.of(Key::OfLink("W", *link)),
                    _ if halves(*action) == 1.0 => factor.of(key(*action, *partly)),
                    _ => factor,
                }
            })
            .collect();
        let formula = signs(&|_, (action, _, partly, _)| part(*action, *partly));
        let set = |numbers: &[Rich]| {
            signs(&|i, (action, ..)| {
                let number = numbers.get(i).cloned().unwrap_or_default();
                let by = halves(*action);
                if by == 1.0 { number } else { number.up(OVER).then(&human::stated(by)) }
            })
        };
        let reckon = |numbers: &[f64]| {
            let each = terms.iter().zip(numbers);
            each.map(|((action, _, _, against), number)| {
                let own = number / halves(*action);
                if *against { own } else { -own }
            })
            .sum()
        };
        let result = Factor::new(size, &units.force, "N").of(key(found, partly));
        let line = match terms[..] {
            // One force is the other.
            [(action, _, _, true)] if halves(*action) == 1.0 => {
                let number = self.figures.borrow_mut().tell(key(*action, false), size, &units.force);
                self.figures.borrow_mut().alias(key(found, partly), key(*action, terms[0].2));
                part(found, partly)
                    .up(EQUALS)
                    .then(&formula)
                    .up(EQUALS)
                    .then(&human::with_unit(&number, &units.force.symbol))
            }
            _ => {
                let (of, told) = (part(found, partly), (result, &units.force));
                self.line_in(true, of, formula, &factors, set, reckon, told)
            }
        };
        let mut lines = vec![Rich::fill(self.n.words.governor_along, &[("equation", line)])];
        lines.extend(self.whole_of_shared(found, size));
        lines
    }

    /// What all halves share, from the part that counts in one.
    fn whole_of_shared(&self, found: Action, size: f64) -> Option<Rich> {
        let units = &self.n.scene.units;
        let halves = self.n.mechanism().halves_of(found);
        if halves == 1.0 {
            return None;
        }
        let exact = Unit { symbol: String::new(), si: 1.0 };
        let factors = [
            Factor::new(halves, &exact, ""),
            Factor::new(size, &units.force, "N").of(self.whole(Force::Vector(found))),
        ];
        let result = Factor::new(halves * size, &units.force, "N").of(Key::Given("shared"));
        let name = self.n.symbol(Quantity::Force(Force::Vector(found), self.mark()), false);
        let formula = human::stated(halves).up(TIMES).up("(").then(&self.symbol(found)).up(")");
        Some(self.line(name, formula, &factors, product, |n| n[0] * n[1], result))
    }

    /// In the second sense the triangle of the sleeve is similar to the one that is drawn.
    fn by_similar_triangle(&self, along: &AlongGuide, governor: &Governor, first: bool) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let (found, size, _) = along.found;
        let other = governor.states.first().and_then(|state| state.along.as_ref());
        let (false, Some(other)) = (first, other) else { return Vec::new() };
        let load = |of: &AlongGuide| {
            of.terms.iter().map(|(_, size, _, against)| if *against { *size } else { -*size }).sum::<f64>()
        };
        let drawn = Teller { share: self.sheet.share, ..*self };
        let (now, then) = (load(along), load(other));
        let factors = [
            Factor::new(other.found.1, &units.force, "N").of(drawn.whole(Force::Vector(found))),
            Factor::new(now, &units.force, "N"),
            Factor::new(then, &units.force, "N"),
        ];
        let result = Factor::new(size, &units.force, "N").of(self.whole(Force::Vector(found)));
        let sum = Rich::upright("Σ").it("F");
        let formula = drawn.symbol(found).up(DOT).then(&sum.clone().up("″")).up(OVER).then(&sum.up("′"));
        let set = |n: &[Rich]| n[0].clone().up(TIMES).then(&n[1]).up(OVER).then(&n[2]);
        let line = self.line(self.symbol(found), formula, &factors, set, |n| n[0] * n[1] / n[2], result);
        vec![Rich::fill(self.n.words.governor_similar, &[("equation", line)])]
    }

    /// What a roller or a bar hands on is one number on both of its sides.
    pub(super) fn hand_on(&self) {
        let Some(governor) = &self.sheet.governor else { return };
        let Some((_, on_arm, by_sleeve)) = governor.hands_on else { return };
        for state in &governor.states {
            let teller = Self { share: state.share, ..*self };
            let [one, other] = [on_arm, by_sleeve].map(|action| teller.whole(Force::Vector(action)));
            self.figures.borrow_mut().alias(one, other);
            self.figures.borrow_mut().alias(other, one);
        }
    }

    /// Moments of the arm, and the speed that belongs to them.
    fn of_arm(&self, governor: &Governor, state: &GovernorState, first: bool) -> Vec<Rich> {
        let units = &self.n.scene.units;
        let mut lines = Vec::new();
        let roller = governor.hands_on.filter(|(link, ..)| self.n.mechanism().link(*link).block);
        if let (true, Some((roller, on_arm, by_sleeve))) = (first, roller) {
            // Whichever of the two is known.
            let equal = self.symbol(on_arm).up("\u{a0}= −\u{2009}").then(&self.symbol(by_sleeve));
            let link = ("link", Rich::upright(self.n.number(roller)));
            lines.push(Rich::fill(self.n.words.governor_hands_on, &[link, ("equation", equal)]));
        }
        self.hand_on();
        lines.extend(self.moments_with(&state.moments, first));
        if governor.sought {
            let (rad, rpm) = (radians(), rpm());
            let factors = [
                Factor::new(state.centrifugal, &units.force, "N")
                    .of(self.whole(Force::Vector(Action::Centrifugal(governor.link)))),
                Factor::new(governor.mass, &units.mass, "kg").of(Key::OfLink("M", governor.link)),
                Factor::new(governor.radius, &units.length, "m").of(Key::Given("radius")),
            ];
            let spin = Quantity::Force(Force::Spin, state.share);
            let result = Factor::new(state.omega, &rad, "rad/s").of(Key::Of(spin));
            let root = |inside: Rich| Rich::upright("√(").then(&inside).up(")");
            let below = self.mass_name(governor).up(DOT).then(&radius_name(governor, self.n));
            let force = self.symbol(Action::Centrifugal(governor.link));
            let formula = root(force.up(OVER).up("(").then(&below).up(")"));
            let set = |n: &[Rich]| {
                let below = n[1].clone().up(TIMES).then(&n[2]);
                root(n[0].clone().up(OVER).up("(").then(&below).up(")"))
            };
            let reckon = |n: &[f64]| libm::sqrt(n[0] / (n[1] * n[2]));
            let of = self.n.symbol(spin, false);
            lines.push(self.line_in(false, of, formula, &factors, set, reckon, (result, &rpm)));
        }
        lines
    }

    /// The name of the instantaneous centre of an arm.
    pub(super) fn centre_line(&self, about: About) -> Option<Rich> {
        let About::Centre { of, line, joint, .. } = about else { return None };
        let parts = [
            ("point", super::forces::centre_name()),
            ("link", Rich::upright(self.n.number(of))),
            ("force", self.symbol(line)),
            ("joint", self.n.point(joint)),
        ];
        Some(Rich::fill(self.n.words.governor_centre, &parts))
    }

    /// An arm is measured once, whatever acts.
    pub(super) fn arms_of(&self, moments: &MomentBalance) -> Vec<Rich> {
        let mut told: Vec<Arm> = Vec::new();
        let mut all = Vec::new();
        for arm in moments.terms.iter().chain([&moments.found]).filter_map(|term| term.arm) {
            let same = |other: &Arm| self.key_of_arm(other) == self.key_of_arm(&arm);
            if told.iter().any(same) || self.is_told(&arm) {
                continue;
            }
            told.push(arm);
            let mm = arm.length / self.construction.space.metres_per_mm;
            let (reading, length) = self.measured(self.key_of_arm(&arm), arm.length, mm);
            let name = arm_name(self.sheet, &arm, self.n);
            all.push(as_measured(name, &reading, &length));
        }
        all
    }

    /// The mark that tells the senses apart, where several are told.
    pub(super) fn mark(&self) -> Share {
        if self.several { self.share } else { Share::Total }
    }
}
