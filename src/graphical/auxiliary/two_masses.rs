//! The inertia of a link as that of two masses, which needs no moment of inertia to be laid off.
//!
//! 1. Two masses on a line through the mass centre G move as the link does where M₁ + M₂ = M, M₁ h₁ = M₂ h₂ and
//!    M₁ h₁² + M₂ h₂² = I: the first one stands where one likes, the second one at h₂ = I / (M h₁) on the other side.
//! 2. The image of the second one divides the line of images as its place divides the link.
//! 3. The inertia of a mass lies in the line of its acceleration. The two lines meet in O, and that of both together, of the
//!    size M A_G and parallel to A_G, passes through it.
//! 4. Where both masses are to stand at pins, their moment of inertia is M a b, whatever that of the link is: the couple
//!    T_c = (M a b − I) ε takes the difference back, and moves the line.
//!
//! Where a mass rests the line is that of the other one; where the two lines do not meet on the paper it is laid off at
//! the distance T/F from G.

use crate::board::{Amount, Direction, Line, Point};
use crate::mechanism::force::Mass;
use crate::mechanism::quantity::Order;
use crate::mechanism::{LinkId, PointId};

use super::super::construction::Label;
use super::super::draughtsman::Draughtsman;
use super::super::forces::{Item, Pull};
use super::{AuxiliaryAct, PointName, StrokeRole};

/// The lines meet on the paper where they do so within this of the mass centre, mm of the page.
const PAPER: f64 = 600.0;
/// Arrows that tell a direction have this length, mm of the page.
const ARROW: f64 = 14.0;
/// The largest acceleration of the small polygon, mm of the page.
const POLYGON: f64 = 28.0;
/// Between the skeleton and the small polygon, mm of the page.
const APART: f64 = 16.0;
/// The polygon stands beside the skeleton where both are not wider than this, else below it, mm of the page.
const BESIDE: f64 = 140.0;

/// An inertia force that was found by two masses.
#[derive(Clone, Copy)]
pub(in super::super) struct ByTwoMasses {
    pub(in super::super) link: LinkId,
    pub(in super::super) masses: (PointId, Option<PointId>),
    pub(in super::super) pull: Pull,
    /// A point of its line, on the skeleton.
    pub(in super::super) through: Point,
}

/// One of the two masses.
#[derive(Clone, Copy)]
struct Particle {
    at: Point,
    image: Point,
    /// The direction of its acceleration; none where it rests.
    toward: Option<Direction>,
}

type Found<T> = Result<T, &'static str>;

impl Draughtsman<'_> {
    /// Draws the construction for a link.
    pub(super) fn draw_two_masses(&mut self, link: LinkId, masses: (PointId, Option<PointId>)) {
        let before = self.board.purpose("two masses in the place of a link");
        match self.two_masses(link, masses) {
            Ok(found) => self.by_two_masses.push(found),
            Err(why) => self.refuse_auxiliary(why),
        }
        self.board.purpose(before);
    }

    fn two_masses(
        &mut self,
        link: LinkId,
        (first, second): (PointId, Option<PointId>),
    ) -> Found<ByTwoMasses> {
        let mass = *self.mechanism.forces.mass(link).ok_or("the link has no mass")?;
        let kilograms = self.kilograms(&mass).ok_or("the link has a moment of inertia and no mass")?;
        let inertia = self.central_inertia(&mass).ok_or("the link has no moment of inertia")?;
        let pull = self.inertia_force(&mass).ok_or("the mass centre does not move")?;
        let centre = self.at(mass.centre);
        let reason = self.reason(&[link]);
        let (along, _) = self.board.toward(pull.tail, pull.head, reason);
        let length = self.arrow_length();
        let tip = self.board.step_off(centre, along, length);
        if !self.stands(tip) {
            return Err("the mass centre has no acceleration");
        }
        let masses = match second {
            None => self.second_mass(&mass, first, [kilograms, inertia])?,
            Some(second) => self.masses_at_pins(&mass, [first, second])?,
        };
        let meet = self.lines_of_masses(&mass, (first, second), masses)?;
        let (from, torque) = match (meet, second) {
            (None, _) => (centre, self.inertia_torque(&mass)),
            (Some(at), None) => (at, None),
            (Some(at), Some(second)) => {
                (at, self.correcting_couple(&mass, [first, second], masses, [kilograms, inertia]))
            }
        };
        let item = Item { pull: Some(pull), at: from, couple: torque };
        let through = self.foot_of_line(&[item]).ok_or("the force has no line")?;
        if meet.is_none() {
            self.act_auxiliary(AuxiliaryAct::LinesApart { link });
        }
        self.draw_line_of_inertia(&mass, kilograms, (pull, along), through);
        self.draw_accelerations(&mass, (first, second), masses);
        Ok(ByTwoMasses { link, masses: (first, second), pull, through })
    }

    /// A length on the page in millimetres of the board.
    fn on_the_page(&self, mm: f64) -> f64 {
        mm * self.per_page
    }

    fn arrow_length(&mut self) -> crate::board::Mm {
        self.board.millimetres(self.on_the_page(ARROW))
    }

    /// The second mass at h₂ = I / (M h₁), and its image in the same ratio.
    fn second_mass(
        &mut self,
        mass: &Mass,
        first: PointId,
        [kilograms, inertia]: [Amount; 2],
    ) -> Found<[Particle; 2]> {
        let scale = self.length_scale();
        let reason = self.reason(&[mass.link]);
        let (at, centre) = (self.at(first), self.at(mass.centre));
        let (along, h1) = self.board.toward(at, centre, reason);
        let reach = self.board.read(h1, scale);
        let moment = self.board.product(kilograms, reach);
        let beyond = self.board.quotient(inertia, moment, reason);
        let h2 = self.board.to_paper(beyond, scale);
        let place = self.board.lay_off(centre, along, h2);
        if !self.stands(place) {
            return Err("the first mass stands at the mass centre");
        }
        let whole = self.board.distance(at, place);
        let ratio = self.board.ratio(whole, h1, reason);
        let (image, middle) = (self.image(Order::Acceleration, first), self.image_of_centre(mass));
        let other = self.board.divide(image, middle, ratio);
        self.act_auxiliary(AuxiliaryAct::SecondMass {
            link: mass.link,
            first,
            mass: kilograms.value(),
            inertia: inertia.value(),
            arms: [reach.value(), beyond.value()],
        });
        self.aux_point(PointName::SecondMass, place);
        self.act_auxiliary(AuxiliaryAct::ImageOfSecond { link: mass.link, first });
        Ok([self.particle(at, image), self.particle(place, other)])
    }

    /// Both masses at pins, with the mass centre between them.
    fn masses_at_pins(&mut self, mass: &Mass, pins: [PointId; 2]) -> Found<[Particle; 2]> {
        let scale = self.length_scale();
        let reason = self.reason(&[mass.link]);
        let ([a, b], centre) = (pins.map(|pin| self.at(pin)), self.at(mass.centre));
        let (along, length) = self.board.toward(a, b, reason);
        let [beside, across] = self.board.square_off(Line { through: a, along }, centre);
        // In the link's own figure they lie in one line, as exactly as it is given; a hand is not that exact.
        let drawn_freely = self.board.tape().trembles();
        if across.value().abs() > STRAIGHT * length.value() && !drawn_freely {
            return Err("the mass centre does not lie on the line of the two pins");
        }
        if !(beside.value() > 0.0 && beside.value() < length.value()) {
            return Err("the mass centre does not lie between the two pins");
        }
        let rest = self.board.less(length, beside);
        let arms = [beside, rest].map(|mm| self.board.read(mm, scale).value());
        self.act_auxiliary(AuxiliaryAct::MassesAtPins { link: mass.link, pins, arms });
        let images = pins.map(|pin| self.image(Order::Acceleration, pin));
        Ok([self.particle(a, images[0]), self.particle(b, images[1])])
    }

    fn particle(&mut self, at: Point, image: Point) -> Particle {
        let pole = self.board.origin();
        let reason = self.reason(&[]);
        let (toward, _) = self.board.toward(pole, image, reason);
        let length = self.arrow_length();
        let tip = self.board.step_off(at, toward, length);
        let toward = self.stands(tip).then_some(toward);
        Particle { at, image, toward }
    }

    fn image_of_centre(&mut self, mass: &Mass) -> Point {
        self.image(Order::Acceleration, mass.centre)
    }

    /// Where the lines of the two masses meet; none where they do not on the paper.
    fn lines_of_masses(
        &mut self,
        mass: &Mass,
        (first, second): (PointId, Option<PointId>),
        [one, other]: [Particle; 2],
    ) -> Found<Option<Point>> {
        let link = mass.link;
        let reason = self.reason(&[link]);
        let centre = self.at(mass.centre);
        let meet = match (one.toward, other.toward) {
            (Some(a), Some(b)) => {
                let (first_line, second_line) =
                    (Line { through: one.at, along: a }, Line { through: other.at, along: b });
                let meet = self.board.meet_lines(first_line, second_line, reason);
                let far = self.board.distance(centre, meet.at);
                let near = self.stands(meet.at) && far.value() <= self.on_the_page(PAPER);
                if near {
                    let crossing = meet.crossing;
                    self.act_auxiliary(AuxiliaryAct::LinesOfMasses { link, first, second, crossing });
                    for particle in [one, other] {
                        self.aux_line(particle.at, meet.at, StrokeRole::Produced, None);
                    }
                    self.aux_point(PointName::MeetOfMasses, meet.at);
                }
                near.then_some(meet.at)
            }
            (None, Some(_)) => {
                self.act_auxiliary(AuxiliaryAct::OneMassRests { link, rests: Some(first), acts: second });
                Some(other.at)
            }
            (Some(_), None) => {
                self.act_auxiliary(AuxiliaryAct::OneMassRests { link, rests: second, acts: Some(first) });
                Some(one.at)
            }
            (None, None) => return Err("neither of the two masses has an acceleration"),
        };
        for (particle, point) in [(one, Some(first)), (other, second)] {
            if let Some(toward) = particle.toward {
                let against = self.board.reverse(toward);
                let length = self.arrow_length();
                let tip = self.board.step_off(particle.at, against, length);
                self.aux_line(particle.at, tip, StrokeRole::Vector, None);
                self.aux_point(PointName::InertiaOfMass(point), tip);
            }
        }
        self.aux_line(one.at, other.at, StrokeRole::Construction, None);
        Ok(meet)
    }

    /// (M a b − I) ε, by which the inertia of two masses at pins turns the link less or more than its own.
    fn correcting_couple(
        &mut self,
        mass: &Mass,
        pins: [PointId; 2],
        [one, other]: [Particle; 2],
        [kilograms, inertia]: [Amount; 2],
    ) -> Option<Amount> {
        if self.translates[mass.link.0] {
            return None;
        }
        let scale = self.length_scale();
        let centre = self.at(mass.centre);
        let arms = [one.at, other.at].map(|at| {
            let mm = self.board.distance(at, centre);
            self.board.read(mm, scale)
        });
        let of_masses = self.board.product(kilograms, arms[0]);
        let of_masses = self.board.product(of_masses, arms[1]);
        let more = self.board.difference(of_masses, inertia);
        let alpha = self.rate(Order::Acceleration, mass.link);
        let couple = self.board.product(more, alpha);
        self.act_auxiliary(AuxiliaryAct::CorrectingCouple {
            link: mass.link,
            pins,
            mass: kilograms.value(),
            inertia: inertia.value(),
            arms: arms.map(|arm| arm.value()),
            alpha: alpha.value(),
            couple: couple.value(),
        });
        Some(couple)
    }

    /// The inertia force in its line, and how far from the mass centre that is.
    fn draw_line_of_inertia(
        &mut self,
        mass: &Mass,
        kilograms: Amount,
        (pull, along): (Pull, Direction),
        through: Point,
    ) {
        let centre = self.at(mass.centre);
        let line = Line { through, along };
        let [beside, _] = self.board.square_off(line, centre);
        let foot = self.board.step_off(through, along, beside);
        let length = self.arrow_length();
        // The arrow stands beside the link; where the lines meet may lie off the paper.
        let tip = self.board.step_off(foot, along, length);
        self.aux_line(foot, through, StrokeRole::Result, None);
        self.aux_line(foot, tip, StrokeRole::Vector, None);
        self.aux_point(PointName::InertiaForce(mass.link), tip);
        let arm = self.arm_of(line, centre).value().abs();
        let [x, y] = self.components_of(pull).map(|part| part.value());
        if self.board.distance(centre, foot).value() > self.on_the_page(1.0) {
            self.aux_line(centre, foot, StrokeRole::Construction, None);
            self.aux_square(foot, centre, tip);
            let half = |axis: usize| (centre.value()[axis] + foot.value()[axis]) / 2.0;
            self.note_named(super::NamedPoint {
                name: PointName::OffsetOfInertia(mass.link),
                at: [half(0), half(1)],
            });
        }
        self.act_auxiliary(AuxiliaryAct::LineOfInertia {
            link: mass.link,
            mass: kilograms.value(),
            size: libm::hypot(x, y),
            arm,
        });
    }

    /// The accelerations beside the skeleton, to a size at which their directions are seen.
    fn draw_accelerations(
        &mut self,
        mass: &Mass,
        (first, second): (PointId, Option<PointId>),
        [one, other]: [Particle; 2],
    ) {
        let middle = self.image_of_centre(mass);
        let label =
            |point: PointId| PointName::Image(Label::Image { point, link: None }, Order::Acceleration);
        let named = [
            (one.image.value(), label(first)),
            (middle.value(), label(mass.centre)),
            (other.image.value(), second.map_or(PointName::ImageOfSecond, label)),
        ];
        let largest = named.iter().map(|([x, y], _)| libm::hypot(*x, *y)).fold(0.0, f64::max);
        if largest <= 0.0 {
            return;
        }
        let grown = self.on_the_page(POLYGON) / largest;
        let all: Vec<[f64; 2]> =
            named.iter().map(|(at, _)| at.map(|mm| mm * grown)).chain([[0.0; 2]]).collect();
        let places: Vec<[f64; 2]> = self.places.iter().flatten().map(Point::value).collect();
        let least = |of: &[[f64; 2]], axis: usize| of.iter().map(|p| p[axis]).fold(f64::INFINITY, f64::min);
        let most =
            |of: &[[f64; 2]], axis: usize| of.iter().map(|p| p[axis]).fold(f64::NEG_INFINITY, f64::max);
        let middle = |of: &[[f64; 2]], axis: usize| f64::midpoint(least(of, axis), most(of, axis));
        let width = |of: &[[f64; 2]]| most(of, 0) - least(of, 0);
        let apart = self.on_the_page(APART);
        let pole = if width(&places) + apart + width(&all) <= self.on_the_page(BESIDE) {
            [most(&places, 0) + apart - least(&all, 0), middle(&places, 1) - middle(&all, 1)]
        } else {
            [middle(&places, 0) - middle(&all, 0), least(&places, 1) - apart - most(&all, 1)]
        };
        let moved = |[x, y]: [f64; 2]| [pole[0] + x * grown, pole[1] + y * grown];
        let name = PointName::Image(Label::Pole, Order::Acceleration);
        self.note_named(super::NamedPoint { name, at: pole });
        for (at, name) in named {
            let to = moved(at);
            self.note_line(pole, to, StrokeRole::Vector);
            self.note_named(super::NamedPoint { name, at: to });
        }
        self.note_line(moved(one.image.value()), moved(other.image.value()), StrokeRole::Construction);
    }

    fn note_line(&mut self, from: [f64; 2], to: [f64; 2], role: StrokeRole) {
        let shape = super::StrokeShape::Line(from, to);
        self.note_stroke(super::Stroke { shape, role, claim: None });
    }

    /// The inertia force of a link as two masses gave it, or why they did not.
    pub(in super::super) fn force_by_two_masses(
        &self,
        link: LinkId,
        masses: (PointId, Option<PointId>),
    ) -> Found<ByTwoMasses> {
        let found = self.by_two_masses.iter().find(|found| found.link == link && found.masses == masses);
        found.copied().ok_or_else(|| {
            let refused = self.record().auxiliary.iter().find_map(|drawing| match drawing.kind {
                crate::plan::Auxiliary::TwoMasses { link: of, first, second }
                    if of == link && (first, second) == masses =>
                {
                    drawing.refused
                }
                _ => None,
            });
            refused.unwrap_or("the two masses were not drawn")
        })
    }
}

/// The mass centre lies on a line that it misses by no more than this part of its length: what own coordinates with all
/// their digits leave.
const STRAIGHT: f64 = 1e-9;
