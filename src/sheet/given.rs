//! What a scene states, in words and formulas: dimensions, places, guides, wheels, the motion that drives.
//!
//! **Architecture Invariant:** everything here is the scene's own; no result of a solver comes in.

use std::f64::consts::TAU;

use super::cycle::of_curve;
use super::human;
use super::notation::Notation;
use super::rich::Rich;
use super::words::Words;
use crate::mechanism::curve::Curve;
use crate::mechanism::force::{
    Action, Area, Force, Heaviness, Inertia, Load, LoadKind, Pointing, Pressure, Share, Size, Spring,
    SpringKind, SpringLaw,
};
use crate::mechanism::friction::{FrictionCircle, Roughness};
use crate::mechanism::quantity::{Asked, Dimension, Measure, Order, Quantity, Unit};
use crate::mechanism::statement::{Locus, Standing, Statement};
use crate::mechanism::{
    Direction, Form, GivenPoint, Guide, GuidePoint, Input, Link, LinkId, Mechanism, Path, Place, PointId,
    Rider, Roll, Sense, Slide,
};

/// A dimension of a link: the distance of two of its points, as stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StatedLength {
    /// One end; a fixed point stands first, as one reads the mechanism.
    pub from: PointId,
    /// Other end.
    pub to: PointId,
    /// Metres.
    pub length: f64,
}

impl StatedLength {
    /// Whether it is the distance of these points.
    #[must_use]
    pub fn is_between(&self, ends: [PointId; 2]) -> bool {
        [[self.from, self.to], [self.to, self.from]].contains(&ends)
    }
}

/// The distances by which a figure states places.
pub(super) fn stated_distances(notation: &Notation<'_>) -> impl Iterator<Item = StatedLength> {
    let mechanism = notation.mechanism();
    let loci = |statement: &'_ Statement| statement.loci.map(|locus| (statement.point, locus));
    let by_figure = mechanism.statements.iter().flat_map(loci).filter_map(|(to, locus)| match locus {
        Locus::Circle { centre, radius } => Some(StatedLength { from: centre, to, length: radius.value }),
        _ => None,
    });
    // How far a driven rider is from the point from which its places are counted.
    let driven = mechanism.inputs.iter().filter_map(|input| {
        let Input::Slide { slide, at: Some(at), .. } = input else { return None };
        let slide = mechanism.slides.get(*slide)?;
        let to = match slide.rider {
            Rider::Pin { point, .. } => point,
            Rider::Link { link, .. } => mechanism.link(link).points.first().copied()?,
        };
        match slide.guide.path {
            Path::Straight { through: GuidePoint::Point(from), offset, .. } if offset.value == 0.0 => {
                Some(StatedLength { from, to, length: at.value.abs() })
            }
            _ => None,
        }
    });
    by_figure.chain(driven)
}

/// The stated dimensions of a link.
#[must_use]
pub fn dimensions(link: &Link, notation: &Notation<'_>) -> Vec<StatedLength> {
    let mechanism = notation.mechanism();
    let mut all = Vec::new();
    let mut distance = |a: usize, b: usize, length: f64| {
        if let (Some(a), Some(b)) = (link.points.get(a), link.points.get(b)) {
            let (from, to) =
                if mechanism.is_fixed(*b) && !mechanism.is_fixed(*a) { (*b, *a) } else { (*a, *b) };
            all.push(StatedLength { from, to, length });
        }
    };
    match &link.form {
        Form::Length(l) => distance(0, 1, l.value),
        Form::Line(positions) => {
            // Each piece between neighbours along the line is a dimension.
            let mut along: Vec<usize> = (0..positions.len()).collect();
            along.sort_by(|a, b| positions[*a].value.total_cmp(&positions[*b].value));
            for pair in along.windows(2) {
                distance(pair[0], pair[1], positions[pair[1]].value - positions[pair[0]].value);
            }
        }
        Form::Sides { first_second, second_third, third_first, .. } => {
            distance(0, 1, first_second.value);
            distance(1, 2, second_third.value);
            distance(2, 0, third_first.value);
        }
        Form::Arms { second, third, .. } => {
            distance(0, 1, second.value);
            distance(0, 2, third.value);
        }
        Form::Shape(_) | Form::Placed | Form::Single => {}
    }
    all
}

/// The dimensions and the motion that the scene states, item by item.
#[must_use]
pub fn items(notation: &Notation<'_>) -> Vec<Rich> {
    items_by(&Teller::of(notation), &[])
}

/// The same without the places of these points, which a drawing dimensions.
fn items_by(teller: &Teller<'_>, dimensioned: &[PointId]) -> Vec<Rich> {
    let notation = teller.n;
    let mechanism = notation.mechanism();
    let mut parts: Vec<Rich> = Vec::new();
    for link in mechanism.moving().map(|l| mechanism.link(l)) {
        teller.link(link, &mut parts);
    }
    for (i, point) in mechanism.points.iter().enumerate() {
        // The origin, where the sheet begins, needs no saying.
        if let Place::Fixed([x, y]) | Place::Placed([x, y]) = point.place
            && (x.value != 0.0 || y.value != 0.0)
            && !dimensioned.contains(&PointId(i))
        {
            parts.push(notation.point(PointId(i)).up("\u{a0}").then(&teller.place(x.value, y.value)));
        }
    }
    for statement in mechanism.statements.iter().filter(|s| s.standing != Standing::Driven) {
        let told = statement.loci.iter().filter(|locus| {
            !teller.is_guide_of(statement.point, locus) && !teller.is_dimension_of(statement.point, locus)
        });
        parts.extend(told.map(|locus| teller.locus(statement.point, locus)));
    }
    for (i, slide) in mechanism.slides.iter().enumerate() {
        parts.extend(teller.guide(i, slide));
    }
    for (index, roll) in mechanism.rolls.iter().enumerate() {
        parts.push(teller.roll(index, roll));
        parts.extend(teller.pressure(index));
    }
    parts.extend(teller.journals());
    teller.forces(&mut parts);
    super::cycle::given(notation, &mut parts);
    for (i, input) in mechanism.inputs.iter().enumerate() {
        teller.input(i, input, &mut parts);
    }
    parts
}

/// The same as one paragraph.
#[must_use]
pub fn paragraph(notation: &Notation<'_>) -> Rich {
    told(notation, items(notation))
}

/// The paragraph of a question: without the places of points that its drawing dimensions, with the scales that the scene
/// states.
#[must_use]
pub fn paragraph_of_question(notation: &Notation<'_>, dimensioned: &[PointId]) -> Rich {
    let teller = Teller { arrows: true, ..Teller::of(notation) };
    let mut parts = items_by(&teller, dimensioned);
    parts.extend(super::results::stated_scales(notation));
    told(notation, parts)
}

fn told(notation: &Notation<'_>, parts: Vec<Rich>) -> Rich {
    if parts.is_empty() {
        return Rich::default();
    }
    let list = Rich::join(&parts, &Rich::upright(notation.words.comma));
    Rich::italic(notation.words.given).up(" ").then(&list)
}

/// A place through which a guide goes: a point by its name, else its coordinates.
#[must_use]
pub fn place_of(point: GuidePoint, notation: &Notation<'_>) -> Rich {
    match point {
        GuidePoint::Point(p) => notation.point(p),
        GuidePoint::Own(at) => Teller::of(notation).own_place(at),
    }
}

/// A straight guide of the frame that is offset from a place: its name, how far it lies beside the place, metres, and on which
/// side.
pub(super) fn beside(index: usize, notation: &Notation<'_>) -> Option<(Rich, f64, Rich)> {
    let slide = notation.mechanism().slides.get(index)?;
    let Path::Straight { through, direction: Direction::Angle(angle), turned, offset } = slide.guide.path
    else {
        return None;
    };
    if offset.value == 0.0 || slide.guide.link != LinkId::FRAME {
        return None;
    }
    let words = notation.words;
    let own = angle.value + turned.value;
    let guide = match notation.lie(index) {
        Some(_) => notation.named_guide(index),
        None => {
            let parts = [("line", notation.named_guide(index)), ("angle", as_written(own, notation))];
            Rich::fill(words.stated_ray, &parts)
        }
    };
    Some((guide, offset.value.abs(), side(own, offset.value, place_of(through, notation), words)))
}

/// On which side of a place, or of a line, a line of this angle lies that is shifted to its left: above or below it, beside it
/// where the line is upright.
pub(super) fn side(along: f64, offset: f64, place: Rich, words: &Words) -> Rich {
    let (sin, cos) = libm::sincos(along);
    let upright = cos.abs() < ROUNDED;
    let side = match (upright, cos * offset > 0.0, -sin * offset > 0.0) {
        (false, true, _) => words.side_above,
        (false, false, _) => words.side_below,
        (true, _, true) => words.side_right,
        (true, _, false) => words.side_left,
    };
    Rich::fill(side, &[("place", place)])
}

/// A stated angle in degrees, with its turns as it is written; one that is written in radians to a hundredth.
pub(super) fn degrees(si: f64, notation: &Notation<'_>) -> Rich {
    match notation.scene.written.angle_of(si) {
        Some((own, true)) => human::hundredths_of_a_degree(own),
        Some((own, false)) => human::degrees(own),
        None => human::degrees(si),
    }
}

/// The same as it is written: radians, with degrees beside them; more than a turn with what a protractor takes of it.
pub(super) fn as_written(si: f64, notation: &Notation<'_>) -> Rich {
    match notation.scene.written.angle_with_turns(si) {
        Some((own, true)) => {
            human::stated(own).up("\u{a0}rad\u{a0}(").then(&human::hundredths_of_a_degree(own)).up(")")
        }
        Some((own, false)) => with_turns(own),
        None => with_turns(si),
    }
}

/// An angle in degrees; of more than a turn the whole turns and the rest: 430° = 360° + 70°.
fn with_turns(angle: f64) -> Rich {
    let told = human::degrees(angle);
    let whole = libm::trunc(angle.abs() / TAU * (1.0 + ROUNDED));
    let rest = angle.abs() - whole * TAU;
    if whole == 0.0 || rest.abs() < ROUNDED {
        return told;
    }
    let sign = if angle < 0.0 { ("−", "\u{a0}−\u{a0}") } else { ("", "\u{a0}+\u{a0}") };
    let turns = if whole == 1.0 { Rich::default() } else { human::number(whole).up("\u{a0}×\u{a0}") };
    let turns = Rich::upright(sign.0).then(&turns).up("360°");
    told.up("\u{a0}=\u{a0}").then(&turns).up(sign.1).then(&human::degrees(rest))
}

/// The line or the arc on which a figure states a point.
pub(super) fn path_of(point: PointId, notation: &Notation<'_>) -> Option<Rich> {
    let own = notation.mechanism().statements.iter().filter(|statement| statement.point == point);
    own.flat_map(|statement| &statement.loci).find_map(|locus| match locus {
        Locus::On(path) => Some(Teller::of(notation).line_of(path)),
        _ => None,
    })
}

/// A stated length in the scene's unit, without the figures that only a calculation has.
pub(super) fn stated_length(si: f64, notation: &Notation<'_>) -> Rich {
    human::stated(stated_number(si, notation))
}

/// The number that then stands there.
pub(super) fn stated_number(si: f64, notation: &Notation<'_>) -> f64 {
    let unit = notation.scene.units.length.si;
    human::rounded_to(si / unit, size(notation) / unit)
}

/// The same with its unit.
pub(super) fn stated_with_unit(si: f64, notation: &Notation<'_>) -> Rich {
    human::with_unit(&stated_length(si, notation), &notation.scene.units.length.symbol)
}

/// The size of what is stated: its longest dimension, or how far its places lie apart, metres.
fn size(notation: &Notation<'_>) -> f64 {
    let mechanism = notation.mechanism();
    let links = mechanism.moving().map(|link| mechanism.link(link));
    let longest = links.flat_map(|link| dimensions(link, notation)).map(|d| d.length).fold(0.0, f64::max);
    let places = || mechanism.points.iter().filter_map(|point| point.place.exact());
    let spread = |axis: usize| {
        let all = places().map(|at| at[axis].value);
        all.clone().fold(f64::NEG_INFINITY, f64::max) - all.fold(f64::INFINITY, f64::min)
    };
    [0, 1].map(spread).into_iter().fold(longest, f64::max)
}

/// As a scene rounds an angle.
const ROUNDED: f64 = 1e-9;

/// The angle of a guide against the axes in which it is stated.
fn turned_from(direction: Direction, turned: f64) -> f64 {
    match direction {
        Direction::Angle(angle) => angle.value + turned,
        Direction::Toward(_) => turned,
    }
}

struct Teller<'a> {
    n: &'a Notation<'a>,
    /// Arrows on the skeleton show which way the riders of straight guides are driven: what is told is how fast.
    arrows: bool,
}

impl<'a> Teller<'a> {
    fn of(n: &'a Notation<'a>) -> Self {
        Self { n, arrows: false }
    }
}

/// Whether an input moves, or speeds up.
fn moves(input: &Input) -> bool {
    let rates = match input {
        Input::Angle { omega, alpha, .. } => [omega.value, alpha.value],
        Input::Speed { .. } => return true,
        Input::Slide { velocity, acceleration, .. } => [velocity.value, acceleration.value],
    };
    rates.iter().any(|rate| *rate != 0.0)
}

/// The unit in which a rate is asked for, where it is another than that in which it is found.
fn own_unit(asked: &Asked, notation: &Notation<'_>) -> Option<String> {
    let found = match asked.quantity.measure() {
        Measure::Velocity => notation.unit(Dimension::Velocity),
        Measure::Acceleration => notation.unit(Dimension::Acceleration),
        Measure::AngularVelocity => notation.angular_unit(Order::Velocity),
        Measure::AngularAcceleration => notation.angular_unit(Order::Acceleration),
        _ => return None,
    };
    (asked.unit != found).then(|| asked.unit.symbol.clone())
}

/// Pascals are small: kPa or MPa in their place.
pub(super) fn handy(unit: &Unit, si: f64) -> Unit {
    let larger = [("MPa", 1e6), ("kPa", 1e3)].into_iter().find(|(_, own)| si.abs() >= 0.1 * own);
    match larger.filter(|_| unit.symbol == "Pa") {
        Some((symbol, si)) => Unit { symbol: symbol.to_owned(), si },
        None => unit.clone(),
    }
}

/// The largest size of a curve, whatever its sign.
pub(super) fn largest(curve: &Curve) -> f64 {
    let sizes: Vec<f64> = match curve {
        Curve::Table { knots, .. } => knots.iter().map(|[_, size]| size.value).collect(),
        Curve::Harmonics { constant, sin, cos } => {
            sin.iter().chain(cos).map(|wave| wave.size.value).chain([constant.value]).collect()
        }
    };
    sizes.into_iter().fold(0.0, |most, size| most.max(size.abs()))
}

impl Teller<'_> {
    fn equals(&self, symbol: Rich, value: &Rich) -> Rich {
        symbol.up("\u{a0}=\u{a0}").then(value)
    }

    /// A length in the unit in which it is written, and in the scene's where that is another: the steps compute in this.
    fn length(&self, si: f64) -> Rich {
        let usual = &self.n.scene.units.length;
        let told = human::with_unit(&stated_length(si, self.n), &usual.symbol);
        let own = self.n.scene.written.unit_of(si, usual);
        if own == *usual {
            return told;
        }
        human::stated_quantity(si, &own).up("\u{a0}=\u{a0}").then(&told)
    }

    fn pair(&self, x: f64, y: f64) -> Rich {
        /// A coordinate that is a smaller part of the other is the rounding of what led to the place.
        const ROUNDED: f64 = 1e-9;
        let unit = self.n.scene.units.length.si;
        let least = ROUNDED * x.abs().max(y.abs());
        let size = size(self.n) / unit;
        let [x, y] = [x, y].map(|si| if si.abs() < least { 0.0 } else { human::rounded_to(si / unit, size) });
        Rich::upright("(")
            .then(&human::stated_beside(x, y))
            .up(";\u{a0}")
            .then(&human::stated_beside(y, x))
            .up(")")
    }

    fn place(&self, x: f64, y: f64) -> Rich {
        human::with_unit(&self.pair(x, y), &self.n.scene.units.length.symbol)
    }

    fn own_place(&self, [x, y]: GivenPoint) -> Rich {
        self.place(x.value, y.value)
    }

    /// A size in the unit in which it is written; where it is written in none, in the usual one.
    fn written(&self, si: f64, usual: &Unit) -> Rich {
        human::stated_quantity(si, &self.n.scene.written.unit_of(si, usual))
    }

    fn number(&self, link: LinkId) -> Rich {
        Rich::upright(self.n.number(link))
    }

    fn link(&self, link: &Link, parts: &mut Vec<Rich>) {
        for d in dimensions(link, self.n) {
            parts.push(self.equals(self.n.length(d.from, d.to), &self.length(d.length)));
        }
        match (&link.form, &link.points[..]) {
            (Form::Sides { turn, .. }, [a, b, c]) => {
                let points = self.n.point(*a).then(&self.n.point(*b)).then(&self.n.point(*c));
                let [ccw, cw] = self.n.words.given_sense;
                let template = if *turn == Sense::Ccw { ccw } else { cw };
                parts.push(Rich::fill(template, &[("points", points)]));
            }
            (Form::Arms { angle, .. }, [a, b, c]) => {
                let points = self.n.point(*b).then(&self.n.point(*a)).then(&self.n.point(*c));
                let written = self.n.scene.written.angle_with_turns(angle.value);
                let own = written.map_or(angle.value, |(own, _)| own);
                let value = human::degrees(own.abs()).word(self.n.sense(own));
                parts.push(self.equals(Rich::upright("∠\u{a0}").then(&points), &value));
            }
            (Form::Shape(places), points) => {
                let place = |(p, at): (&PointId, &GivenPoint)| {
                    self.n.point(*p).up("\u{a0}").then(&self.own_place(*at))
                };
                let places: Vec<Rich> = points.iter().zip(places).map(place).collect();
                let places = Rich::join(&places, &Rich::upright(self.n.words.comma));
                let link = ("link", Rich::upright(link.number.to_string()));
                parts.push(Rich::fill(self.n.words.given_shape, &[link, ("places", places)]));
            }
            _ => {}
        }
    }

    /// Whether a locus is the guide on which the point rides, which is told among the guides.
    fn is_guide_of(&self, of: PointId, locus: &Locus) -> bool {
        let rides = |slide: &Slide| match slide.rider {
            Rider::Pin { point, .. } => point == of,
            Rider::Link { link, .. } => self.n.mechanism().link(link).points.first() == Some(&of),
        };
        let Locus::On(path) = locus else { return false };
        self.n.mechanism().slides.iter().any(|slide| slide.guide.path == *path && rides(slide))
    }

    /// Whether a locus is a distance that a link's dimensions give.
    fn is_dimension_of(&self, of: PointId, locus: &Locus) -> bool {
        let Locus::Circle { centre, .. } = *locus else { return false };
        let mechanism = self.n.mechanism();
        let mut own = mechanism.moving().flat_map(|link| dimensions(mechanism.link(link), self.n));
        own.any(|own| own.is_between([centre, of]))
    }

    /// What is stated of a point's place.
    fn locus(&self, of: PointId, locus: &Locus) -> Rich {
        let words = self.n.words;
        match *locus {
            Locus::Circle { centre, radius } => {
                self.equals(self.n.length(centre, of), &self.length(radius.value))
            }
            Locus::Ray { from, direction } => {
                let angle = ("angle", as_written(direction.value, self.n));
                Rich::fill(words.stated_ray, &[("line", self.n.length(from, of)), angle])
            }
            Locus::Square { through, to: [from, to] } => {
                self.n.length(through, of).up("\u{a0}⊥\u{a0}").then(&self.n.length(from, to))
            }
            Locus::Sees { ends: [from, to], angle } => {
                let points = self.n.point(from).then(&self.n.point(of)).then(&self.n.point(to));
                self.equals(Rich::upright("∠\u{a0}").then(&points), &human::degrees(angle.value.abs()))
            }
            Locus::On(path) => {
                let line = self.line_of(&path);
                Rich::fill(words.stated_on, &[("point", self.n.point(of)), ("line", line)])
            }
        }
    }

    /// A line or an arc: by its name where it is a guide.
    fn line_of(&self, path: &Path) -> Rich {
        let guide = self.n.mechanism().slides.iter().position(|slide| slide.guide.path == *path);
        guide.map_or_else(|| self.path(path), |slide| self.n.guide(slide))
    }

    /// A line or an arc that is no guide of a sliding pair.
    fn path(&self, path: &Path) -> Rich {
        let words = self.n.words;
        let named = |point: GuidePoint| place_of(point, self.n);
        let (told, turned, offset) = match *path {
            Path::Arc { centre, radius } => {
                let radius = ("radius", self.length(radius.value));
                return Rich::fill(words.stated_arc, &[("centre", named(centre)), radius]);
            }
            Path::Straight { through, direction: Direction::Angle(angle), turned, offset } => {
                let angle = ("angle", as_written(angle.value + turned.value, self.n));
                (Rich::fill(words.stated_line, &[("place", named(through)), angle]), None, offset)
            }
            Path::Straight { through, direction: Direction::Toward(target), turned, offset } => {
                let line = match through {
                    GuidePoint::Point(p) => self.n.length(p, target),
                    GuidePoint::Own(at) => {
                        self.own_place(at).up("\u{2009}→\u{2009}").then(&self.n.point(target))
                    }
                };
                (line, Some(turned).filter(|turned| turned.value != 0.0), offset)
            }
        };
        let told = match turned {
            Some(turned) => {
                let angle = ("angle", as_written(turned.value, self.n));
                told.up(" ").then(&Rich::fill(words.given_turned, &[angle]))
            }
            None => told,
        };
        if offset.value == 0.0 {
            return told;
        }
        told.up(" ").then(&Rich::fill(words.given_offset, &[("offset", self.length(offset.value))]))
    }

    fn guide(&self, index: usize, slide: &Slide) -> Option<Rich> {
        let words = self.n.words;
        let link = ("link", self.number(slide.guide.link));
        let moving = slide.guide.link != LinkId::FRAME;
        let guide = ("guide", if moving { self.n.guide_of(index) } else { self.n.guide(index) });
        let (through, direction, turned, offset) = match slide.guide.path {
            Path::Arc { centre, radius } => {
                let centre = match centre {
                    GuidePoint::Point(p) => self.n.point(p),
                    GuidePoint::Own(at) if moving => self.by_own_axes(slide.guide.link, self.own_place(at)),
                    GuidePoint::Own(at) => self.own_place(at),
                };
                let radius = ("radius", self.length(radius.value));
                return Some(Rich::fill(words.given_guide_arc, &[guide, link, ("centre", centre), radius]));
            }
            Path::Straight { through, direction, turned, offset } => (through, direction, turned, offset),
        };
        let place = place_of(through, self.n);
        if let Some((guide, own, side)) = beside(index, self.n).filter(|_| !self.drives(index)) {
            let parts = [("guide", guide), ("offset", self.length(own)), ("side", side)];
            return Some(self.held_at(index, Rich::fill(words.given_guide_beside, &parts)));
        }
        let told = match direction {
            // A rider that drives has a sense along its guide, which the angle tells.
            Direction::Angle(_)
                if self.n.lie(index).is_some() && (!self.drives(index) || self.led_from(index).is_some()) =>
            {
                let guide = ("guide", self.n.named_guide(index));
                Rich::fill(words.given_guide_through, &[guide, ("place", place)])
            }
            Direction::Angle(angle) => {
                let angle = ("angle", as_written(angle.value + turned.value, self.n));
                let frame = slide.guide.link == LinkId::FRAME;
                // A link that is nothing but a guide has no axes of its own.
                let alone = matches!(self.n.mechanism().link(slide.guide.link).form, Form::Single)
                    && matches!(through, GuidePoint::Point(_));
                if let (false, Some(line)) = (frame, self.line_from(slide.guide.link, through)) {
                    let told = Rich::fill(words.given_guide_line, &[guide, link, ("line", line)]);
                    let own = turned_from(direction, turned.value);
                    let along = libm::sin(own).abs() < ROUNDED;
                    let aside = || Rich::fill(words.given_turned, &[("angle", as_written(own, self.n))]);
                    let told = if along { told } else { told.up(" ").then(&aside()) };
                    return Some(self.held_at(index, self.offset(told, offset.value)));
                }
                let template = match (frame, alone) {
                    (true, _) => words.given_guide,
                    // Its axes are those of the guide on which it rides.
                    (false, true) if self.rides_along(slide.guide.link) => words.given_slot_at,
                    (false, true) => words.given_slot_through,
                    (false, false) => words.given_guide_moving,
                };
                let told = Rich::fill(template, &[guide, link, ("place", place), angle]);
                match (frame, through) {
                    (false, GuidePoint::Own(_)) => self.by_own_axes(slide.guide.link, told),
                    _ => told,
                }
            }
            Direction::Toward(target) => {
                let line = match through {
                    GuidePoint::Point(p) => self.n.length(p, target),
                    GuidePoint::Own(_) => place.up("\u{2009}→\u{2009}").then(&self.n.point(target)),
                };
                let line = match through {
                    GuidePoint::Own(_) if moving => self.by_own_axes(slide.guide.link, line),
                    _ => line,
                };
                let told = Rich::fill(words.given_guide_line, &[guide, link, ("line", line)]);
                let told = match slide.rider {
                    Rider::Link { link, .. } => {
                        match (held_along(slide, link, self.n), self.own_line(link)) {
                            (Some((sign, line)), Some(own)) => {
                                let held = own.up("\u{a0}").up(sign).up("\u{a0}").then(&line);
                                told.up(words.comma).then(&held)
                            }
                            _ => told,
                        }
                    }
                    Rider::Pin { .. } => told,
                };
                if turned.value == 0.0 {
                    told
                } else {
                    let angle = ("angle", as_written(turned.value, self.n));
                    told.up(" ").then(&Rich::fill(words.given_turned, &[angle]))
                }
            }
        };
        Some(self.held_at(index, self.offset(told, offset.value)))
    }

    /// A guide with the angle at which the own line of the link that slides without turning is held to it, where that lies
    /// neither along it nor along or square to the line that was told.
    fn held_at(&self, index: usize, guide: Rich) -> Rich {
        let slide = &self.n.mechanism().slides[index];
        let Rider::Link { link, turned: Some(turned) } = slide.rider else { return guide };
        let Some(own) = self.own_line(link).filter(|_| held_along(slide, link, self.n).is_none()) else {
            return guide;
        };
        if turned.value == 0.0 {
            return guide;
        }
        let angle = human::degrees(turned.value.abs()).word(self.n.sense(turned.value));
        let line = self.n.guide_of(index);
        let held = Rich::fill(self.n.words.given_from_line, &[("angle", angle), ("line", line)]);
        guide.up(self.n.words.comma).then(&own).up(" ").then(&held)
    }

    /// A guide of a moving link with how far it lies beside the line that was told, and on which side of who follows that.
    fn offset(&self, guide: Rich, offset: f64) -> Rich {
        if offset == 0.0 {
            return guide;
        }
        let words = self.n.words;
        let template = if offset > 0.0 { words.given_offset_left } else { words.given_offset_right };
        guide.up(" ").then(&Rich::fill(template, &[("offset", self.length(offset.abs()))]))
    }

    /// The own line of a link of two joints, where a guide begins at the first of them: its angle is measured from there.
    fn line_from(&self, link: LinkId, through: GuidePoint) -> Option<Rich> {
        let first = self.n.mechanism().link(link).points.first().copied()?;
        self.own_line(link).filter(|_| through == GuidePoint::Point(first))
    }

    /// Whether a link rides without turning on a guide of the frame along its own axes.
    fn rides_along(&self, link: LinkId) -> bool {
        self.n.mechanism().slides.iter().any(|slide| {
            matches!(slide.rider, Rider::Link { link: own, turned: Some(turned) } if own == link && turned.value == 0.0)
                && slide.guide.link == LinkId::FRAME
                && matches!(slide.guide.path, Path::Straight { .. })
        })
    }

    /// The line of a link that has nothing but a length, by its ends.
    fn own_line(&self, link: LinkId) -> Option<Rich> {
        let link = self.n.mechanism().link(link);
        match (&link.form, &link.points[..]) {
            (Form::Length(_), [from, to, ..]) => Some(self.n.length(*from, *to)),
            _ => None,
        }
    }

    /// From where the place of a driven rider is measured along its guide on the frame, and in which direction that and its
    /// velocity are positive.
    fn led_from(&self, index: usize) -> Option<[(&'static str, Rich); 2]> {
        let placed =
            |input: &Input| matches!(input, Input::Slide { slide, at: Some(_), .. } if *slide == index);
        let slide = self.n.mechanism().slides.get(index).filter(|own| own.guide.link == LinkId::FRAME)?;
        let Path::Straight { through, direction: Direction::Angle(angle), turned, offset } = slide.guide.path
        else {
            return None;
        };
        let told = offset.value == 0.0 && self.n.mechanism().inputs.iter().any(placed);
        let angle = as_written(angle.value + turned.value, self.n);
        told.then(|| [("place", place_of(through, self.n)), ("angle", angle)])
    }

    /// From where places along a straight guide are counted.
    fn counted_from(&self, index: usize) -> (&'static str, Rich) {
        let path = self.n.mechanism().slides.get(index).map(|slide| slide.guide.path);
        let place = match path {
            Some(Path::Straight { through, .. }) => place_of(through, self.n),
            _ => Rich::default(),
        };
        ("place", place)
    }

    /// Whether the rider on this guide is driven along it.
    fn drives(&self, index: usize) -> bool {
        let along = |input: &Input| matches!(input, Input::Slide { slide, .. } if *slide == index);
        self.n.mechanism().inputs.iter().any(along)
    }

    /// The angle of pressure of a rolling pair.
    fn pressure(&self, roll: usize) -> Option<Rich> {
        let angle = self.n.mechanism().forces.pressure(roll)?;
        Some(Rich::fill(self.n.words.given_pressure, &[("angle", human::degrees(angle.value))]))
    }

    /// The teeth of a rolling pair, where they are stated, and their module.
    fn gears(&self, index: usize) -> Option<[(&'static str, Rich); 2]> {
        let gears = self.n.scene.gears.get(index)?.as_ref()?;
        let teeth: Vec<Rich> = gears.teeth.iter().map(|z| human::stated(f64::from(*z))).collect();
        let teeth = Rich::join(&teeth, &Rich::upright(self.n.words.and));
        Some([("teeth", teeth), ("module", self.length(gears.module))])
    }

    fn roll(&self, index: usize, roll: &Roll) -> Rich {
        match roll {
            Roll::Circles { links, radii, internal, .. } => {
                self.wheels(index, *links, radii.map(|radius| radius.value), *internal)
            }
            Roll::Line { guide, wheel, radius, .. } => {
                let told = self.wheel_on_line(guide, *wheel, radius.value);
                match self.gears(index) {
                    Some(gears) => {
                        let gears = Rich::fill(self.n.words.given_pinion, &gears);
                        told.up("\u{a0}(").then(&gears).up(")")
                    }
                    None => told,
                }
            }
        }
    }

    /// Two wheels that roll on each other.
    fn wheels(&self, index: usize, links: [LinkId; 2], radii: [f64; 2], internal: bool) -> Rich {
        let words = self.n.words;
        let radii = Rich::join(&radii.map(|radius| self.length(radius)), &Rich::upright(words.and));
        let parts = [("one", self.number(links[0])), ("other", self.number(links[1])), ("radii", radii)];
        match (self.gears(index), internal) {
            (Some(gears), false) => Rich::fill(words.given_gears, &[&parts[..], &gears].concat()),
            (Some(gears), true) => Rich::fill(words.given_gears_inside, &[&parts[..], &gears].concat()),
            (None, false) => Rich::fill(words.given_wheels, &parts),
            (None, true) => Rich::fill(words.given_wheels_inside, &parts),
        }
    }

    /// A wheel on a rail or a rack.
    fn wheel_on_line(&self, guide: &Guide, wheel: LinkId, radius: f64) -> Rich {
        let words = self.n.words;
        let radius = ("radius", self.length(radius));
        let wheel = ("wheel", self.number(wheel));
        if let (LinkId::FRAME, Path::Straight { through, direction, turned, offset }) =
            (guide.link, guide.path)
            && let Direction::Angle(angle) = direction
        {
            let own = angle.value + turned.value;
            let angle = ("angle", as_written(own, self.n));
            let place = ("place", place_of(through, self.n));
            let level = libm::sin(own).abs() < ROUNDED;
            let template = if level { words.given_rail_level } else { words.given_rail };
            let told = Rich::fill(template, &[wheel, radius, place, angle]);
            let aside = [("offset", self.length(offset.value))];
            let offset = (offset.value != 0.0).then(|| Rich::fill(words.given_offset, &aside));
            return offset.map_or(told.clone(), |offset| told.up(" ").then(&offset));
        }
        let link = ("link", self.number(guide.link));
        let Path::Straight { through, direction, turned, offset } = guide.path else {
            return Rich::default();
        };
        let own = turned_from(direction, turned.value);
        let line = match (direction, through) {
            (Direction::Toward(to), GuidePoint::Point(from)) => Some(self.n.length(from, to)),
            (Direction::Toward(to), GuidePoint::Own(at)) => {
                let line = self.own_place(at).up("\u{2009}→\u{2009}").then(&self.n.point(to));
                Some(self.by_own_axes(guide.link, line))
            }
            (Direction::Angle(_), _) => self.line_from(guide.link, through),
        };
        let Some(line) = line else {
            // A link that is nothing but a line has no axes of its own, or those of the guide on which it rides.
            let alone = matches!(self.n.mechanism().link(guide.link).form, Form::Single)
                && matches!(through, GuidePoint::Point(_));
            let template = match (alone, self.rides_along(guide.link)) {
                (true, true) => words.given_rack_at,
                (true, false) => words.given_rack_through,
                (false, _) => words.given_rack_moving,
            };
            let (place, angle) = (("place", place_of(through, self.n)), ("angle", as_written(own, self.n)));
            let told = Rich::fill(template, &[wheel, radius, link, place, angle]);
            let told = if alone { told } else { self.by_own_axes(guide.link, told) };
            return self.offset(told, offset.value);
        };
        let told = Rich::fill(words.given_rack_line, &[wheel, radius, ("line", line), link]);
        // Which way a line runs is no matter where nothing lies to its left.
        let off = match offset.value == 0.0 {
            true => libm::sin(own),
            false => libm::remainder(own, TAU),
        };
        let aside = || Rich::fill(words.given_turned, &[("angle", as_written(own, self.n))]);
        let told = if off.abs() < ROUNDED { told } else { told.up(" ").then(&aside()) };
        self.offset(told, offset.value)
    }

    /// Own places or angles of a link with a length, and from where they are measured.
    fn by_own_axes(&self, link: LinkId, places: Rich) -> Rich {
        let Some(line) = self.own_line(link) else { return places };
        let from = self.n.mechanism().link(link).points.first().map(|p| self.n.point(*p)).unwrap_or_default();
        Rich::fill(self.n.words.given_own_place, &[("places", places), ("from", from), ("line", line)])
    }

    /// Weights, moments of inertia, loads and springs.
    fn forces(&self, parts: &mut Vec<Rich>) {
        let mechanism = self.n.mechanism();
        let forces = &mechanism.forces;
        let units = &self.n.scene.units;
        for mass in &forces.masses {
            let number = self.n.number(mass.link);
            let at = |symbol: Rich| symbol.up("(").then(&self.n.point(mass.centre)).up(")");
            match mass.heaviness {
                Heaviness::Mass(kg) => {
                    let symbol = at(Rich::italic("M").sub(&number));
                    parts.push(self.equals(symbol, &self.written(kg.value, &units.mass)));
                }
                Heaviness::Weight(weight) => {
                    let symbol = at(Rich::italic("W").sub(&number));
                    parts.push(self.equals(symbol, &self.written(weight.value, &units.force)));
                }
                Heaviness::None => {}
            }
            let inertia = |about: Option<PointId>| {
                let about = about.map(|p| self.n.index(p)).unwrap_or_default();
                let comma = if about.is_empty() { "" } else { "," };
                Rich::italic("I").sub(&format!("{number}{comma}{about}"))
            };
            match mass.inertia {
                Inertia::Point => {}
                Inertia::Central(value) => {
                    parts.push(self.equals(inertia(None), &self.written(value.value, &units.inertia)));
                }
                Inertia::About(point, value) => {
                    let symbol = inertia(Some(point));
                    parts.push(self.equals(symbol, &self.written(value.value, &units.inertia)));
                }
                Inertia::Gyration(radius) => {
                    parts.push(self.equals(Rich::italic("ρ").sub(&number), &self.length(radius.value)));
                }
            }
        }
        parts.extend(self.own_places());
        let weighs = forces.masses.iter().any(|mass| matches!(mass.heaviness, Heaviness::Weight(_)));
        if forces.gravity.acts || (weighs && mechanism.inputs.iter().any(moves)) {
            let g = human::stated_quantity(forces.gravity.g.value, &self.unit_of_gravity());
            let told = self.equals(Rich::italic("g"), &g);
            let direction = forces.gravity.direction.value;
            let down = (direction - crate::mechanism::force::Gravity::DOWN.value).abs() < 1e-12;
            parts.push(match (forces.gravity.acts, down) {
                (true, false) => told.up("\u{a0}∠\u{a0}").then(&degrees(direction, self.n)),
                (true, true) => told,
                (false, _) => {
                    told.up("\u{a0}(").then(&Rich::upright(self.n.words.given_weights_rest)).up(")")
                }
            });
        }
        for (index, load) in forces.loads.iter().enumerate() {
            parts.push(self.load(index, load));
        }
        for spring in &forces.springs {
            let symbol = |letter: &str| Rich::italic(letter).sub(&spring.name);
            if let SpringKind::Pull([(_, from), (_, to)]) = spring.kind {
                let ends = [("from", self.n.point(from)), ("to", self.n.point(to))];
                let name = [("name", Rich::italic(&spring.name))];
                parts.push(Rich::fill(self.n.words.given_spring, &[&name[..], &ends].concat()));
            }
            if let SpringKind::Torsion([from, to]) = spring.kind {
                let links = [("from", self.number(from)), ("to", self.number(to))];
                let name = [("name", Rich::italic(&spring.name))];
                parts.push(Rich::fill(self.n.words.given_torsion, &[&name[..], &links].concat()));
                parts.extend(self.torsion(spring));
                continue;
            }
            match spring.law {
                SpringLaw::Stiffness { stiffness, free } => {
                    if let Size::Given(stiffness) = stiffness {
                        let value = self.written(stiffness.value, &units.stiffness);
                        parts.push(self.equals(symbol("K"), &value));
                    }
                    parts.push(self.equals(symbol("l"), &self.length(free.value)));
                }
                SpringLaw::Force(Size::Given(force)) => {
                    parts.push(self.equals(symbol("F"), &self.written(force.value, &units.force)));
                }
                SpringLaw::Force(_) => {}
            }
        }
        self.friction(parts);
    }

    /// Metres per second squared beside newtons; beside pounds what the scene measures in.
    fn unit_of_gravity(&self) -> Unit {
        let own = self.n.unit(Dimension::Acceleration);
        let metric = ["nm/", "um/", "mm/", "cm/", "km/"].iter().any(|length| own.symbol.starts_with(length));
        let seconds = self.n.scene.units.time.si == 1.0;
        if metric && seconds { Unit { symbol: "m/s^2".to_owned(), si: 1.0 } } else { own }
    }

    /// Whether a rate of zero need not be told: forces of a mechanism at rest, of which nobody asks how it moves.
    fn rests(&self, rates: [f64; 2]) -> bool {
        let mechanism = self.n.mechanism();
        let of_motion = |asked: &Asked| {
            !matches!(asked.quantity, Quantity::Force(..) | Quantity::Cycle(_))
                && asked.quantity.order() >= Order::Velocity
        };
        rates == [0.0; 2] && !mechanism.forces.is_empty() && !mechanism.asked.iter().any(of_motion)
    }

    /// How hard a torsion spring turns: its stiffness and the angle without load, or its torque.
    fn torsion(&self, spring: &Spring) -> Vec<Rich> {
        let symbol = |letter: &str| Rich::italic(letter).sub(&spring.name);
        match spring.law {
            SpringLaw::Stiffness { stiffness, free } => {
                let mut told = Vec::new();
                if let Size::Given(stiffness) = stiffness {
                    let unit = Unit { symbol: "N*m/rad".to_owned(), si: 1.0 };
                    told.push(self.equals(symbol("K"), &human::stated_quantity(stiffness.value, &unit)));
                }
                told.push(self.equals(symbol("φ"), &human::degrees(free.value)));
                told
            }
            SpringLaw::Force(Size::Given(torque)) => {
                let value = self.written(torque.value.abs(), &self.n.scene.units.torque);
                vec![self.equals(symbol("T"), &value.word(self.n.sense(torque.value)))]
            }
            SpringLaw::Force(_) => Vec::new(),
        }
    }

    /// What rubs: f or φ of pins and guides, the radius of a circle that is given, a constant drag.
    fn friction(&self, parts: &mut Vec<Rich>) {
        let mechanism = self.n.mechanism();
        let friction = &mechanism.forces.friction;
        let rough = |roughness: Roughness, place: &str| match roughness {
            Roughness::Coefficient(f) => self.equals(Rich::italic("f").sub(place), &human::stated(f.value)),
            Roughness::Angle(angle) => {
                self.equals(Rich::italic("φ").sub(place), &human::degrees(angle.value))
            }
        };
        for rubbing in &friction.pins {
            let place = self.n.index(rubbing.pin);
            // Between two links it is the same which of them holds the pin.
            let carrier = mechanism.rubbing_carrier(rubbing.pin);
            if let (Some(link), true) = (carrier, mechanism.parties_at(rubbing.pin).len() > 2) {
                let told =
                    [("point", self.n.point(rubbing.pin)), ("link", Rich::upright(self.n.number(link)))];
                parts.push(Rich::fill(self.n.words.given_pin_held, &told));
            }
            match rubbing.circle {
                FrictionCircle::Radius(radius) => {
                    let symbol = Rich::italic("r").sub(&format!("f,{place}"));
                    parts.push(self.equals(symbol, &self.length(radius.value)));
                }
                FrictionCircle::Journal { radius, roughness } => {
                    parts.push(self.equals(Rich::italic("r").sub(&place), &self.length(radius.value)));
                    parts.push(rough(roughness, &place));
                }
            }
        }
        for rubbing in &friction.slides {
            let guide = self.n.number(mechanism.slides[rubbing.slide].guide.link);
            let point = mechanism.pin_of_slide(rubbing.slide).map(|point| self.n.index(point));
            let place = point.map_or(guide.clone(), |point| format!("{guide}{point}"));
            if let Some(roughness) = rubbing.resistance.roughness() {
                parts.push(rough(roughness, &place));
            }
            let halves = self.n.mechanism().forces.spin.map_or(1.0, |spin| f64::from(spin.balls));
            if let Some(drag) = rubbing.resistance.drag() {
                let size = human::stated_quantity(drag.value * halves, &self.n.scene.units.force);
                parts.push(self.equals(Rich::italic("D").sub(&place), &size));
            }
        }
    }

    /// Points that masses, loads and springs have by own coordinates, link by link.
    fn own_places(&self) -> Vec<Rich> {
        let words = self.n.words;
        let mechanism = self.n.mechanism();
        let mut all = Vec::new();
        for link in mechanism.moving().map(|link| mechanism.link(link)) {
            let own = link.points.iter().enumerate().filter_map(|(i, p)| Some((*p, link.extra_at(i)?)));
            let places: Vec<Rich> =
                own.map(|(p, at)| self.n.point(p).up("\u{a0}").then(&self.own_place(at))).collect();
            if places.is_empty() {
                continue;
            }
            let places = ("places", Rich::join(&places, &Rich::upright(words.comma)));
            all.push(match own_axis(link) {
                Some([from, to]) => {
                    let parts = [places, ("from", self.n.point(from)), ("line", self.n.length(from, to))];
                    Rich::fill(words.given_own_place, &parts)
                }
                None => {
                    let link = ("link", Rich::upright(link.number.to_string()));
                    Rich::fill(words.given_shape, &[link, places])
                }
            });
        }
        all
    }

    fn load(&self, index: usize, load: &Load) -> Rich {
        let units = &self.n.scene.units;
        let mechanism = self.n.mechanism();
        let name = super::force_names::load(self.n, index);
        let on = match load.at() {
            Some(at) => self.n.point(at),
            None => Rich::upright(self.n.number(load.link)),
        };
        // The symbol of a torque without a name says on which link it acts.
        let says = load.at().is_none() && super::force_names::is_unnamed(self.n, index);
        let name = if says { name } else { name.up("(").then(&on).up(")") };
        let motion = |with: bool, torque: bool| {
            let velocity = match (torque, load.at()) {
                (false, Some(at)) => self.n.symbol(Quantity::Velocity(at), false),
                _ => self.n.symbol(Quantity::Omega(load.link), false),
            };
            let words = if with { self.n.words.given_with } else { self.n.words.given_against };
            Rich::upright("\u{a0}").then(&Rich::fill(words, &[("velocity", velocity)]))
        };
        let size = |size: Size, unit: &Unit| match size {
            Size::Given(given) => self.written(given.value, unit),
            Size::Curve(curve) => of_curve(&mechanism.forces.curves[curve], unit),
            Size::Pressure { pressure, area } => {
                let pressure = match pressure {
                    Pressure::Given(pressure) => {
                        self.written(pressure.value, &handy(&units.pressure, pressure.value))
                    }
                    Pressure::Curve(curve) => {
                        let curve = &mechanism.forces.curves[curve];
                        of_curve(curve, &handy(&units.pressure, largest(curve)))
                    }
                };
                let told = self.equals(Rich::italic("p"), &pressure).up(self.n.words.comma);
                match area {
                    Area::Given(area) => {
                        let length = &units.length;
                        let square =
                            Unit { symbol: format!("{}^2", length.symbol), si: length.si * length.si };
                        let area = human::stated_quantity(area.value, &square);
                        told.then(&self.equals(Rich::italic("A"), &area))
                    }
                    Area::Bore { bore, rod } => {
                        let told = told.then(&self.equals(Rich::italic("D"), &self.length(bore.value)));
                        match rod {
                            Some(rod) => {
                                let rod = self.equals(Rich::italic("d"), &self.length(rod.value));
                                told.up(self.n.words.comma).then(&rod)
                            }
                            None => told,
                        }
                    }
                }
            }
            Size::Sought => Rich::upright("?"),
        };
        match load.kind {
            LoadKind::Torque { size: of, with_motion } => {
                let told = match of {
                    Size::Sought => name.word(self.n.words.given_sought),
                    // A sense, not a sign.
                    Size::Given(given) if with_motion.is_none() => {
                        let value = self.written(given.value.abs(), &units.torque);
                        self.equals(name, &value.word(self.n.sense(given.value)))
                    }
                    _ => self.equals(name, &size(of, &units.torque)),
                };
                match with_motion {
                    Some(with) => told.then(&motion(with, true)),
                    None => told,
                }
            }
            LoadKind::Vector { parts: [x, y], of, .. } => {
                let number = |si: f64| human::stated(si / units.force.si);
                let pair =
                    Rich::upright("(").then(&number(x.value)).up(";\u{a0}").then(&number(y.value)).up(")");
                let told = self.equals(name, &human::with_unit(&pair, &units.force.symbol));
                if of == LinkId::FRAME {
                    return told;
                }
                told.up(" ").then(&Rich::fill(self.n.words.given_own_axes, &[("link", self.number(of))]))
            }
            LoadKind::Force { size: of, pointing, .. } => {
                let told = match of {
                    Size::Sought => name.word(self.n.words.given_sought),
                    // What presses is told before what it comes to.
                    Size::Pressure { .. } => name.up(":\u{a0}").then(&size(of, &units.force)),
                    _ => self.equals(name, &size(of, &units.force)),
                };
                let told = told.up(" ");
                let words = self.n.words;
                match pointing {
                    Pointing::Own { link, angle } if link != LinkId::FRAME => {
                        let parts = [("angle", degrees(angle.value, self.n)), ("link", self.number(link))];
                        told.then(&Rich::fill(words.given_to_own_axis, &parts))
                    }
                    Pointing::World(angle) | Pointing::Own { angle, .. } => {
                        told.up("∠\u{a0}").then(&degrees(angle.value, self.n))
                    }
                    Pointing::Between { from, to, turned } => {
                        let line = ("line", self.n.length(from, to));
                        if turned.value == 0.0 {
                            return told.then(&Rich::fill(words.given_along, &[line]));
                        }
                        let angle = human::degrees(turned.value.abs()).word(self.n.sense(turned.value));
                        told.then(&Rich::fill(words.given_from_line, &[line, ("angle", angle)]))
                    }
                    Pointing::Motion { with } => told.then(&motion(with, false)),
                }
            }
        }
    }

    /// The journals of the pins, pins of one radius together; nothing where no rubbing speed is asked.
    fn journals(&self) -> Vec<Rich> {
        let mechanism = self.n.mechanism();
        if !mechanism.asked.iter().any(|asked| matches!(asked.quantity, Quantity::Rub(..))) {
            return Vec::new();
        }
        let mut radii: Vec<(f64, Vec<Rich>)> = Vec::new();
        for (i, point) in mechanism.points.iter().enumerate() {
            let Some(radius) = point.journal else { continue };
            let name = self.n.point(PointId(i));
            match radii.iter_mut().find(|(r, _)| *r == radius.value) {
                Some((_, points)) => points.push(name),
                None => radii.push((radius.value, vec![name])),
            }
        }
        let told = |(radius, points): (f64, Vec<Rich>)| {
            let points = Rich::join(&points, &Rich::upright(self.n.words.comma));
            let radius = ("radius", self.length(radius));
            Rich::fill(self.n.words.given_journal, &[("points", points), radius])
        };
        radii.into_iter().map(told).collect()
    }

    /// A rate in the unit in which the scene states it.
    fn rate(&self, si: f64, unit: &Unit, senses: bool) -> Rich {
        let value = human::stated_quantity(if senses { si.abs() } else { si }, unit);
        let sense = if senses { self.n.sense(si) } else { "" };
        if sense.is_empty() { value } else { value.word(sense) }
    }

    fn input(&self, index: usize, input: &Input, parts: &mut Vec<Rich>) {
        // A governor that rests is about to move: how fast does not matter.
        if self.n.mechanism().forces.spin.is_some_and(|spin| spin.imagined) {
            let mut own = Vec::new();
            self.input_that_moves(index, input, &mut own);
            // A place that is stated comes before the rate.
            let rate = own.pop();
            parts.extend(own);
            parts.extend(rate.map(|rate| Rich::fill(self.n.words.given_imagined, &[("list", rate)])));
            return;
        }
        self.input_that_moves(index, input, parts);
    }

    fn input_that_moves(&self, index: usize, input: &Input, parts: &mut Vec<Rich>) {
        let stated = self.n.scene.input_units.get(index);
        let rate_unit = |usual: Unit| stated.and_then(|s| s.rate.clone()).unwrap_or(usual);
        let second_unit = |usual: Unit| stated.and_then(|s| s.second.clone()).unwrap_or(usual);
        let angle = |link, angle: f64| {
            let angle = stated.and_then(|s| s.angle).unwrap_or(angle);
            self.equals(self.n.symbol(Quantity::Angle(link), false), &as_written(angle, self.n))
        };
        match input {
            Input::Angle { link, angle: at, omega, alpha } => {
                parts.extend(at.map(|at| angle(*link, at.value)));
                if self.rests([omega.value, alpha.value]) {
                    return;
                }
                let unit = rate_unit(self.n.angular_unit(Order::Velocity));
                let value = self.constant(self.rate(omega.value, &unit, true), alpha.value);
                parts.push(self.equals(self.n.symbol(Quantity::Omega(*link), false), &value));
                self.second(
                    Quantity::Alpha(*link),
                    alpha.value,
                    &second_unit(self.alpha_unit()),
                    true,
                    parts,
                );
            }
            Input::Speed { angle: at, point, speed, link, alpha } => {
                parts.extend(at.map(|at| angle(*link, at.value)));
                let unit = rate_unit(self.n.unit(Dimension::Velocity));
                let value = self.constant(self.rate(speed.value, &unit, true), alpha.value);
                parts.push(self.equals(self.n.symbol(Quantity::Velocity(*point), false), &value));
                self.second(
                    Quantity::Alpha(*link),
                    alpha.value,
                    &second_unit(self.alpha_unit()),
                    true,
                    parts,
                );
            }
            Input::Slide { slide, at, velocity, acceleration } => {
                let Some(point) = self.n.mechanism().pin_of_slide(*slide) else { return };
                if let Some(at) = at {
                    let distance = ("distance", self.length(at.value));
                    let point = ("point", self.n.point(point));
                    parts.push(match self.led_from(*slide).filter(|_| self.n.lie(*slide).is_some()) {
                        Some(from) => {
                            Rich::fill(self.n.words.given_at_angle, &[&[point, distance], &from[..]].concat())
                        }
                        None => {
                            Rich::fill(self.n.words.given_at, &[point, distance, self.counted_from(*slide)])
                        }
                    });
                }
                if self.rests([velocity.value, acceleration.value]) {
                    return;
                }
                // What drives a slide on a moving guide drives it along that guide.
                let guide = self.n.mechanism().slides.get(*slide).map(|slide| slide.guide);
                let [first, second] = match guide.map(|guide| guide.link) {
                    Some(link) if link != LinkId::FRAME => {
                        [Quantity::Slip(point, link), Quantity::SlipAcceleration(point, link)]
                    }
                    _ => [Quantity::Velocity(point), Quantity::Acceleration(point)],
                };
                let is_straight = guide.is_some_and(|guide| matches!(guide.path, Path::Straight { .. }));
                let arrow = self.arrows && is_straight && velocity.value != 0.0;
                let size = |rate: f64| if arrow { rate.abs() } else { rate };
                let unit = rate_unit(self.n.unit(Dimension::Velocity));
                let value = self.constant(self.rate(size(velocity.value), &unit, false), acceleration.value);
                parts.push(self.equals(self.n.symbol(first, false), &value));
                let unit = second_unit(self.n.unit(Dimension::Acceleration));
                self.second(second, size(acceleration.value), &unit, false, parts);
                if let (true, Some(told)) = (arrow && acceleration.value != 0.0, parts.last_mut()) {
                    let words = self.n.words;
                    let with = velocity.value.signum() == acceleration.value.signum();
                    let words = if with { words.in_sense_of } else { words.against_sense_of };
                    let sense = Rich::fill(words, &[("rotation", self.n.symbol(first, false))]);
                    *told = told.clone().up("\u{a0}").then(&sense);
                }
            }
        }
    }

    /// A rate with the word that it does not change, where somebody asks for what depends on that.
    fn constant(&self, rate: Rich, change: f64) -> Rich {
        let forces = &self.n.mechanism().forces;
        // Inertia hangs on accelerations as well.
        let inertial = !forces.masses.is_empty() && forces.spin.is_none();
        let fast = |asked: &Asked| {
            asked.quantity.order() == Order::Acceleration
                || inertial && matches!(asked.quantity, Quantity::Force(..))
        };
        if change == 0.0 && self.n.mechanism().asked.iter().any(fast) {
            rate.up("\u{a0}(").up(self.n.words.given_constant).up(")")
        } else {
            rate
        }
    }

    fn alpha_unit(&self) -> Unit {
        self.n.angular_unit(Order::Acceleration)
    }

    /// A second rate, which is zero where it is not stated.
    fn second(&self, quantity: Quantity, value: f64, unit: &Unit, senses: bool, parts: &mut Vec<Rich>) {
        if value != 0.0 {
            parts.push(self.equals(self.n.symbol(quantity, false), &self.rate(value, unit, senses)));
        }
    }
}

/// The points of a link between which its own x-axis runs from its origin, where its dimensions say so.
fn own_axis(link: &Link) -> Option<[PointId; 2]> {
    let origin = link.points.iter().copied().find(|point| link.has_at_origin(*point))?;
    let to = match &link.form {
        Form::Length(_) | Form::Sides { .. } | Form::Arms { .. } => link.points.get(1).copied(),
        Form::Line(along) => {
            let ahead = link.points.iter().zip(along).find(|(_, along)| along.value > 0.0);
            ahead.map(|(point, _)| *point)
        }
        Form::Shape(_) | Form::Placed | Form::Single => None,
    };
    to.map(|to| [origin, to])
}

/// How the own line of a link lies against that of the points which lead its guide, where it slides without turning against
/// it: along it or square to it.
pub(super) fn held_along(
    slide: &Slide,
    link: LinkId,
    notation: &Notation<'_>,
) -> Option<(&'static str, Rich)> {
    /// As a scene rounds it.
    const ROUNDED: f64 = 1e-9;
    let Rider::Link { link: own, turned: Some(turned) } = slide.rider else { return None };
    let Path::Straight {
        through: GuidePoint::Point(from),
        direction: Direction::Toward(to),
        turned: of_guide,
        ..
    } = slide.guide.path
    else {
        return None;
    };
    let (sin, cos) = libm::sincos(turned.value + of_guide.value);
    let sign = match () {
        () if own != link => return None,
        () if sin.abs() < ROUNDED => "∥",
        () if cos.abs() < ROUNDED => "⊥",
        () => return None,
    };
    Some((sign, notation.length(from, to)))
}

/// Whether the scene itself says what a quantity is: the rates of its inputs, the rotation of what cannot turn.
pub(super) fn is_stated(quantity: Quantity, notation: &Notation<'_>) -> bool {
    let mechanism = notation.mechanism();
    let driven = |input: &Input| match *input {
        Input::Angle { link, .. } => {
            matches!(quantity, Quantity::Omega(l) | Quantity::Alpha(l) if l == link)
        }
        Input::Speed { point, link, .. } => {
            quantity == Quantity::Velocity(point) || quantity == Quantity::Alpha(link)
        }
        Input::Slide { slide, .. } => mechanism.slides.get(slide).is_some_and(|slide| {
            let Rider::Pin { point, .. } = slide.rider else { return false };
            let rates = [Quantity::Velocity(point), Quantity::Acceleration(point)];
            slide.guide.link == LinkId::FRAME && rates.contains(&quantity)
        }),
    };
    let turns = match quantity {
        Quantity::Omega(link) | Quantity::Alpha(link) => !only_translates(link, mechanism, 0),
        _ => true,
    };
    !turns || mechanism.inputs.iter().any(driven)
}

/// Whether a link cannot turn: it slides along a straight guide of the frame, or of another link that cannot.
pub(super) fn only_translates(link: LinkId, mechanism: &Mechanism, depth: usize) -> bool {
    if link == LinkId::FRAME {
        return true;
    }
    // Two links that slide on each other in a circle hold no other.
    if depth > mechanism.links.len() {
        return false;
    }
    let rides = |slide: &Slide| match slide.rider {
        Rider::Pin { block, .. } => block == Some(link),
        Rider::Link { link: own, .. } => own == link,
    };
    let straight = |slide: &Slide| matches!(slide.guide.path, Path::Straight { .. });
    let mut guides = mechanism.slides.iter().filter(|s| rides(s) && straight(s));
    guides.any(|slide| only_translates(slide.guide.link, mechanism, depth + 1))
}

/// What is asked, one item per kind, but what the scene states.
#[must_use]
pub fn asked(notation: &Notation<'_>) -> Vec<Rich> {
    let words = notation.words;
    let kinds = [
        words.asked_places,
        words.asked_angles,
        words.asked_transmission,
        words.asked_centres,
        words.asked_velocities,
        words.asked_omegas,
        words.asked_ratios,
        words.asked_rubbing,
        words.asked_accelerations,
        words.asked_radii,
        words.asked_alphas,
        words.asked_forces,
        words.asked_torques,
        words.asked_arms,
    ];
    let kind = |quantity: Quantity| match quantity {
        Quantity::Position(_) => 0,
        Quantity::Angle(_) => 1,
        Quantity::Transmission(..) => 2,
        Quantity::Centre(..) => 3,
        Quantity::Omega(_) | Quantity::RelativeOmega(..) | Quantity::Force(Force::Spin, _) => 5,
        Quantity::Ratio(..) | Quantity::Advantage(..) => 6,
        Quantity::Rub(..) => 7,
        Quantity::PathRadius(_) => 9,
        Quantity::Alpha(_) | Quantity::RelativeAlpha(..) => 10,
        Quantity::Force(force, _) if force.turns() => 12,
        Quantity::Force(Force::Offset(_) | Force::Arm(..), _) => 13,
        Quantity::Force(..) => 11,
        other if other.order() == Order::Acceleration => 8,
        _ => 4,
    };
    // A quantity that is asked by several methods is one quantity.
    let mut lists: [Vec<(&Asked, Vec<&str>)>; 14] = Default::default();
    let all = &notation.mechanism().asked;
    let open: Vec<&Asked> = all.iter().filter(|asked| !is_stated(asked.quantity, notation)).collect();
    // Where nothing else is asked, that is the question.
    let open = if open.is_empty() { all.iter().collect() } else { open };
    let mut of_cycle: Vec<Rich> = Vec::new();
    for asked in open {
        if let Quantity::Cycle(of) = asked.quantity {
            let name = Rich::upright(super::cycle::in_words(of, words));
            of_cycle.push(name.up("\u{a0}").then(&notation.symbol(asked.quantity, false)));
            continue;
        }
        let list = &mut lists[kind(asked.quantity)];
        let method = notation.method(asked.method);
        match list.iter_mut().find(|(first, _)| first.quantity == asked.quantity) {
            Some((_, methods)) => methods.extend(method),
            None => list.push((asked, method.into_iter().collect())),
        }
    }
    let name = |(asked, methods): &(&Asked, Vec<&str>)| {
        let symbol = notation.symbol(asked.quantity, false);
        let symbol = match own_unit(asked, notation) {
            Some(unit) => symbol.up("\u{a0}(").up(&human::pretty(&unit)).up(")"),
            None => symbol,
        };
        let symbol = match asked.quantity {
            Quantity::Force(_, Share::Rising) => symbol.up("\u{a0}(").up(words.governor_up).up(")"),
            Quantity::Force(_, Share::Falling) => symbol.up("\u{a0}(").up(words.governor_down).up(")"),
            Quantity::Force(_, Share::Static) => symbol.up("\u{a0}(").up(words.asked_alone[0]).up(")"),
            Quantity::Force(_, Share::Inertia) => symbol.up("\u{a0}(").up(words.asked_alone[1]).up(")"),
            Quantity::Force(Force::Vector(Action::Shaking), _) => {
                symbol.up("\u{a0}(").up(words.asked_whole[0]).up(")")
            }
            Quantity::Force(Force::Vector(Action::OnFrame), _) => {
                symbol.up("\u{a0}(").up(words.asked_whole[1]).up(")")
            }
            _ => symbol,
        };
        match methods.as_slice() {
            [] => symbol,
            methods => {
                let methods = Rich::upright(methods.join(words.comma));
                let by = Rich::fill(words.by_method, &[("methods", methods)]);
                symbol.up("\u{a0}(").then(&by).up(")")
            }
        }
    };
    let told = kinds.into_iter().zip(lists).filter(|(_, list)| !list.is_empty());
    told.map(|(what, list)| {
        let what = what[list.len().min(what.len()) - 1];
        let list: Vec<Rich> = list.iter().map(name).collect();
        Rich::fill(words.asked, &[("what", Rich::upright(what)), ("list", notation.list(&list))])
    })
    .chain((!of_cycle.is_empty()).then(|| notation.list(&of_cycle)))
    .collect()
}
