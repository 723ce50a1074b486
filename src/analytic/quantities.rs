//! Every asked quantity as a formula over the solved motion.

use super::constraints::{Formulas, Scope, Site};
use super::model::{Contact, Track};
use super::motion::Solved;
use super::state::{Measured, State};
use super::tape::{Calculus, U, Var, Vector, dot, minus, plus, quarter, turned};
use crate::mechanism::quantity::{Answer, Indeterminate, Order, Quantity};
use crate::mechanism::{LinkId, PointId, Rider};

/// A divisor (a relative angular velocity, a relative velocity) whose bound passes a quarter of it (its
/// first-order error an eighth) counts as zero.
const ZERO: f64 = 4.0;

type Read = Result<Answer, Indeterminate>;

fn undefined<T>(why: impl Into<String>) -> Result<T, Indeterminate> {
    Err(Indeterminate::Undefined { why: why.into() })
}

/// Components of the derivative of a vector.
fn parts<'t>(vector: Vector<'t>, order: u8) -> [Var<'t>; 2] {
    vector.map(|jet| jet.at(order))
}

fn difference<'t>(a: [Var<'t>; 2], b: [Var<'t>; 2]) -> [Var<'t>; 2] {
    [a[0] - b[0], a[1] - b[1]]
}

fn scaled<'t>(a: [Var<'t>; 2], by: Var<'t>) -> [Var<'t>; 2] {
    [a[0] * by, a[1] * by]
}

fn square<'t>(a: [Var<'t>; 2]) -> Var<'t> {
    a[0] * a[0] + a[1] * a[1]
}

impl State {
    /// The value of a quantity in SI units with its bound: |value − truth| ≤ bound for every mechanism
    /// whose given numbers lie within their errors. The first-order bound is doubled.
    ///
    /// Indeterminate where the motion is not determined by the inputs, where the quantity has no meaning
    /// (no common link, no common pin, no journal radius), or where its order was not solved. An index
    /// that is not of the mechanism is undefined, not a panic.
    #[must_use]
    pub fn answer(&self, quantity: &Quantity) -> Answer {
        self.try_answer(quantity).unwrap_or_else(Answer::Indeterminate)
    }

    fn try_answer(&self, quantity: &Quantity) -> Read {
        self.check(quantity)?;
        match *quantity {
            Quantity::Velocity(p) => self.point_vector(p, None, 1),
            Quantity::RelativeVelocity(p, o) => self.point_vector(p, Some(o), 1),
            Quantity::Acceleration(p) => self.point_vector(p, None, 2),
            Quantity::RelativeAcceleration(p, o) => self.point_vector(p, Some(o), 2),
            Quantity::RelativeNormal(p, o) => self.rotation(self.common_link(p, o)?, p, o, true),
            Quantity::RelativeTangential(p, o) => self.rotation(self.common_link(p, o)?, p, o, false),
            Quantity::Normal(p) | Quantity::Tangential(p) => {
                let normal = matches!(quantity, Quantity::Normal(_));
                match self.pivot(p)? {
                    Some((link, pivot)) => self.rotation(link, p, pivot, normal),
                    None => Ok(Answer::Vector { value: [0.0; 2], bound: 0.0 }),
                }
            }
            Quantity::Omega(link) => self.turning(link, None, 1),
            Quantity::Ratio(link, other) | Quantity::Advantage(other, link) => self.ratio(link, other),
            Quantity::RelativeOmega(link, other) => self.turning(link, Some(other), 1),
            Quantity::Alpha(link) => self.turning(link, None, 2),
            Quantity::RelativeAlpha(link, other) => self.turning(link, Some(other), 2),
            Quantity::Slip(p, link)
            | Quantity::SlipAcceleration(p, link)
            | Quantity::SlipNormal(p, link)
            | Quantity::SlipTangential(p, link)
            | Quantity::Coriolis(p, link) => self.slipping(quantity, p, link),
            Quantity::CoincidentVelocity(p, link) => {
                let spot = self.spot(p, link)?;
                self.vector(1, self.unit(1, 1), |s| parts(s.carried(link.0, spot.place(s)), 1))
            }
            Quantity::CoincidentAcceleration(p, link) => {
                let spot = self.spot(p, link)?;
                self.vector(2, self.unit(1, 2), |s| parts(s.carried(link.0, spot.place(s)), 2))
            }
            Quantity::CoincidentNormal(p, link) => self.coincident_part(p, link, true),
            Quantity::CoincidentTangential(p, link) => self.coincident_part(p, link, false),
            Quantity::TurningVelocity(p, o, link) => self.turned_against(p, link, o),
            Quantity::TurningNormal(p, o, link) => self.part_about(p, link, o, true),
            Quantity::TurningTangential(p, o, link) => self.part_about(p, link, o, false),
            Quantity::ContactNormal(p, a, b) => {
                let spot = self.spot(p, a)?;
                self.vector(2, self.unit(1, 2), |s| {
                    let place = spot.place(s);
                    difference(parts(s.carried(a.0, place), 2), parts(s.carried(b.0, place), 2))
                })
            }
            Quantity::Centre(a, b) => self.centre(a, b),
            Quantity::Rub(p, a, b) => self.rubbing(p, a, b),
            Quantity::PathRadius(p) => self.path_radius(p),
            Quantity::Position(p) => self.position(p),
            Quantity::Angle(link) => self.scalar(0, 1.0, |s| s.angle(link.0).v.wrapped()),
            Quantity::Transmission(coupler, output) => self.transmission(coupler, output),
            Quantity::Force(force, share) => self.force(force, share).and_then(finite),
            Quantity::Cycle(of) => match &self.cycle {
                Some(Ok(turning)) => Ok(turning.answer(of)),
                Some(Err(why)) => undefined(why.clone()),
                None => undefined("the turning-moment diagram was not solved"),
            },
        }
    }

    fn check(&self, quantity: &Quantity) -> Result<(), Indeterminate> {
        let m = &self.model.mechanism;
        let (points, links) = quantity.about();
        let (mut points, mut links) = (points.into_iter().flatten(), links.into_iter().flatten());
        if points.any(|p| p.0 >= m.points.len()) || links.clone().any(|l| l.0 >= m.links.len()) {
            return undefined("it names nothing in this mechanism");
        }
        if links.any(|l| !self.model.kept[l.0]) {
            return undefined("it was not solved for");
        }
        Ok(())
    }

    fn unit(&self, lengths: u8, order: u8) -> f64 {
        let length = if lengths == 1 { self.model.length } else { 1.0 };
        let per = match order {
            0 => 1.0,
            1 => self.model.time,
            _ => self.model.time * self.model.time,
        };
        length / per
    }

    fn name(&self, point: PointId) -> &str {
        &self.model.mechanism.points[point.0].name
    }

    fn number(&self, link: LinkId) -> u32 {
        self.model.mechanism.links[link.0].number
    }

    fn scalar(&self, order: u8, unit: f64, formula: impl for<'t> Fn(&Scope<'t>) -> Var<'t>) -> Read {
        let [m] = self.read(order, self.solved.as_ref(), |s| [formula(s)])?;
        finite(Answer::Scalar { value: m.value * unit, bound: m.bound * unit })
    }

    fn vector(&self, order: u8, unit: f64, formula: impl for<'t> Fn(&Scope<'t>) -> [Var<'t>; 2]) -> Read {
        let m = self.read(order, self.solved.as_ref(), formula)?;
        vector(m, unit)
    }

    /// A place in metres from one in scaled units.
    fn place(&self, scaled: [Measured; 2]) -> Read {
        let mut value = [0.0; 2];
        let mut bounds = [0.0; 2];
        for (i, m) in scaled.iter().enumerate() {
            value[i] = self.model.reference[i] + self.model.length * m.value;
            let rounding = if self.model.reference[i] == 0.0 { 0.0 } else { 2.0 * U * value[i].abs() };
            bounds[i] = self.model.length * m.bound + rounding;
        }
        finite(Answer::Vector { value, bound: libm::hypot(bounds[0], bounds[1]) })
    }

    /// The body in which a point's motion is read: the frame, else a link whose motion is determined.
    fn carrier(&self, point: PointId, except: Option<LinkId>) -> Result<Site, Indeterminate> {
        let sites = &self.model.sites[point.0];
        let allowed = || sites.iter().filter(|s| except.is_none_or(|link| link.0 != s.body));
        let determined = |site: &&Site| {
            let lost = self.solved.as_ref().map(|s| &s.undetermined);
            lost.is_none_or(|lost| !lost[3 * site.body..3 * site.body + 3].contains(&true))
        };
        match allowed().find(determined).or_else(|| allowed().next()).or_else(|| sites.first()) {
            Some(site) => Ok(*site),
            None => undefined(format!("{} is in no link", self.name(point))),
        }
    }

    /// Where a pin or a contact is, by another body than this one.
    fn spot(&self, point: PointId, except: LinkId) -> Result<Spot, Indeterminate> {
        match self.model.contact(point) {
            Some(contact) => Ok(Spot::Contact(contact)),
            None => self.carrier(point, Some(except)).map(Spot::Site),
        }
    }

    fn position(&self, point: PointId) -> Read {
        let spot = self.standing(point)?;
        self.place(self.read(0, None, |s| parts(spot.place(s), 0))?)
    }

    /// A place in metres, without its bound.
    pub(super) fn position_seen(&self, point: PointId) -> Result<[f64; 2], Indeterminate> {
        self.check(&Quantity::Position(point))?;
        let spot = self.standing(point)?;
        let scaled = self.glance(|s| parts(spot.place(s), 0))?;
        Ok([0, 1].map(|i| self.model.reference[i] + self.model.length * scaled[i]))
    }

    /// Where a point is: at a contact, where it was given, or in a link.
    fn standing(&self, point: PointId) -> Result<Spot, Indeterminate> {
        if let Some(contact) = self.model.contact(point) {
            return Ok(Spot::Contact(contact));
        }
        if let Some(own) = self.model.places[point.0] {
            return Ok(Spot::Site(Site { body: 0, own }));
        }
        self.carrier(point, None).map(Spot::Site)
    }

    fn point_vector(&self, point: PointId, from: Option<PointId>, order: u8) -> Read {
        let unit = self.unit(1, order);
        let site = self.carrier(point, None)?;
        let Some(from) = from else {
            return self.vector(order, unit, |s| parts(s.site(&site), order));
        };
        // Two points of one link: the difference is exact in the link's own rotation.
        if let Ok(link) = self.common_link(point, from) {
            let ends = self.ends(link, point, from)?;
            return self.vector(order, unit, |s| parts(arm(s, &ends), order));
        }
        let other = self.carrier(from, None)?;
        self.vector(order, unit, |s| parts(minus(s.site(&site), s.site(&other)), order))
    }

    fn ends(&self, link: LinkId, to: PointId, from: PointId) -> Result<[Site; 2], Indeterminate> {
        let find = |point: PointId| self.model.sites[point.0].iter().find(|s| s.body == link.0).copied();
        match (find(to), find(from)) {
            (Some(to), Some(from)) => Ok([to, from]),
            _ => undefined(format!(
                "{} and {} are not both in link {}",
                self.name(to),
                self.name(from),
                self.number(link)
            )),
        }
    }

    fn common_link(&self, a: PointId, b: PointId) -> Result<LinkId, Indeterminate> {
        let bodies = |p: PointId| self.model.sites[p.0].iter().map(|s| s.body);
        let common: Vec<usize> = bodies(a)
            .filter(|x| *x < self.model.mechanism.links.len() && bodies(b).any(|y| *x == y))
            .collect();
        let lost = self.solved.as_ref().map(|s| &s.undetermined);
        let determined =
            common.iter().find(|body| lost.is_none_or(|l| !l[3 * **body..3 * **body + 3].contains(&true)));
        match determined.or_else(|| common.first()) {
            Some(body) => Ok(LinkId(*body)),
            None => undefined(format!("{} and {} are in no common link", self.name(a), self.name(b))),
        }
    }

    /// The link by which a point is pivoted to the frame, and the pivot; `None` for a fixed point.
    fn pivot(&self, point: PointId) -> Result<Option<(LinkId, PointId)>, Indeterminate> {
        let m = &self.model.mechanism;
        if m.is_fixed(point) {
            return Ok(None);
        }
        let links = self.model.sites[point.0].iter().filter(|s| s.body < m.links.len());
        for site in links {
            if let Some(pivot) = m.links[site.body].points.iter().find(|p| m.is_fixed(**p)) {
                return Ok(Some((LinkId(site.body), *pivot)));
            }
        }
        undefined(format!("{} is in no link that is pivoted to the frame", self.name(point)))
    }

    /// −ω² r or α × r, r from `from` to `to` in the link.
    fn rotation(&self, link: LinkId, to: PointId, from: PointId, normal: bool) -> Read {
        let ends = self.ends(link, to, from)?;
        let unit = self.unit(1, 2);
        if normal {
            return self.vector(1, unit, |s| {
                let omega = s.angle(link.0).d;
                scaled(parts(arm(s, &ends), 0), -(omega * omega))
            });
        }
        self.vector(2, unit, |s| scaled(parts(quarter(arm(s, &ends)), 0), s.angle(link.0).a))
    }

    /// −ω² r or α × r of the point of a pivoted link that lies under a pin, r from the fixed pivot.
    fn coincident_part(&self, pin: PointId, link: LinkId, normal: bool) -> Read {
        let m = &self.model.mechanism;
        let Some(pivot) = m.links[link.0].points.iter().copied().find(|p| m.is_fixed(*p)) else {
            return undefined(format!("link {} is not pivoted to the frame", self.number(link)));
        };
        self.part_about(pin, link, pivot, normal)
    }

    /// −ω² r or, where it is not `normal`, α × r of the point of a link that lies under a pin, r from the point of the
    /// link that lies under another: SI units, with its bound.
    #[must_use]
    pub fn part_of_turning(&self, pin: PointId, link: LinkId, from: PointId, normal: bool) -> Answer {
        self.check(&Quantity::Coriolis(pin, link))
            .and_then(|()| self.check(&Quantity::Coriolis(from, link)))
            .and_then(|()| self.part_about(pin, link, from, normal))
            .unwrap_or_else(Answer::Indeterminate)
    }

    /// ω × r, r from the point of a link that lies under one pin to that which lies under another.
    fn turned_against(&self, pin: PointId, link: LinkId, from: PointId) -> Read {
        let (spot, centre) = (self.spot(pin, link)?, self.spot(from, link)?);
        self.vector(1, self.unit(1, 1), |s| {
            let [x, y] = difference(parts(spot.place(s), 0), parts(centre.place(s), 0));
            let omega = s.angle(link.0).d;
            [-(y * omega), x * omega]
        })
    }

    fn part_about(&self, pin: PointId, link: LinkId, from: PointId, normal: bool) -> Read {
        let (spot, centre) = (self.spot(pin, link)?, self.spot(from, link)?);
        let unit = self.unit(1, 2);
        if normal {
            return self.vector(1, unit, |s| {
                let omega = s.angle(link.0).d;
                scaled(difference(parts(spot.place(s), 0), parts(centre.place(s), 0)), -(omega * omega))
            });
        }
        self.vector(2, unit, |s| {
            let [x, y] = difference(parts(spot.place(s), 0), parts(centre.place(s), 0));
            let alpha = s.angle(link.0).a;
            [-(y * alpha), x * alpha]
        })
    }

    /// |v|³ / |v × a|.
    fn path_radius(&self, point: PointId) -> Read {
        if self.model.mechanism.is_fixed(point) {
            return undefined(format!("{} does not move", self.name(point)));
        }
        let site = self.carrier(point, None)?;
        let [speed, bending] = self.read(2, self.solved.as_ref(), |s| {
            let place = s.site(&site);
            let (v, a) = (parts(place, 1), parts(place, 2));
            [square(v), v[0] * a[1] - v[1] * a[0]]
        })?;
        if speed.value <= ZERO * speed.bound {
            return undefined(format!("{} stands still here", self.name(point)));
        }
        if bending.value.abs() <= ZERO * bending.bound {
            return undefined(format!("the path of {} runs straight here", self.name(point)));
        }
        self.scalar(2, self.unit(1, 0), |s| {
            let place = s.site(&site);
            let (v, a) = (parts(place, 1), parts(place, 2));
            square(v) * square(v).sqrt() / (v[0] * a[1] - v[1] * a[0]).abs()
        })
    }

    fn turning(&self, link: LinkId, other: Option<LinkId>, order: u8) -> Read {
        self.scalar(order, self.unit(0, order), |s| {
            let own = s.angle(link.0).at(order);
            match other {
                Some(other) => own - s.angle(other.0).at(order),
                None => own,
            }
        })
    }

    /// ω of the first link over that of the second.
    fn ratio(&self, link: LinkId, other: LinkId) -> Read {
        let [turns] = self.read(1, self.solved.as_ref(), |s| [s.angle(other.0).d])?;
        if turns.value.abs() <= ZERO * turns.bound {
            return undefined(format!("ω{} is zero", self.number(other)));
        }
        self.scalar(1, 1.0, |s| s.angle(link.0).d / s.angle(other.0).d)
    }

    fn slipping(&self, quantity: &Quantity, point: PointId, link: LinkId) -> Read {
        let site = self.carrier(point, Some(link))?;
        let track = self
            .model
            .mechanism
            .slides
            .iter()
            .position(|slide| slide.guide.link == link && self.model.rider_point(&slide.rider) == Some(point))
            .and_then(|slide| self.model.track(slide).copied());
        match quantity {
            Quantity::Slip(..) => self.vector(1, self.unit(1, 1), |s| slip_velocity(s, &site, link)),
            Quantity::Coriolis(..) => {
                self.vector(1, self.unit(1, 2), |s| coriolis(s, slip_velocity(s, &site, link), link))
            }
            Quantity::SlipAcceleration(..) => {
                self.vector(2, self.unit(1, 2), |s| slip_acceleration(s, &site, link))
            }
            _ => {
                let normal = matches!(quantity, Quantity::SlipNormal(..));
                match track {
                    None => undefined(format!(
                        "{} does not slide on link {}",
                        self.name(point),
                        self.number(link)
                    )),
                    Some(Track::Line(_)) if normal => Ok(Answer::Vector { value: [0.0; 2], bound: 0.0 }),
                    Some(Track::Line(_)) => {
                        self.vector(2, self.unit(1, 2), |s| slip_acceleration(s, &site, link))
                    }
                    Some(Track::Arc(arc)) if normal => self.vector(1, self.unit(1, 2), |s| {
                        // −(slip²/r²) r: towards the centre of curvature.
                        let radius = parts(minus(s.site(&site), s.site(&arc.centre)), 0);
                        scaled(radius, -(square(slip_velocity(s, &site, link)) / square(radius)))
                    }),
                    Some(Track::Arc(arc)) => self.vector(2, self.unit(1, 2), |s| {
                        let tangent = parts(quarter(minus(s.site(&site), s.site(&arc.centre))), 0);
                        let apparent = slip_acceleration(s, &site, link);
                        let along = apparent[0] * tangent[0] + apparent[1] * tangent[1];
                        scaled(tangent, along / square(tangent))
                    }),
                }
            }
        }
    }

    fn rubbing(&self, point: PointId, a: LinkId, b: LinkId) -> Read {
        let Some(journal) = self.model.mechanism.points[point.0].journal else {
            return undefined(format!("the pin {} has no journal radius", self.name(point)));
        };
        let [omega] = self.read(1, self.solved.as_ref(), |s| [(s.angle(a.0).d - s.angle(b.0).d).abs()])?;
        let unit = self.unit(0, 1);
        let (value, bound) = (omega.value * unit, omega.bound * unit);
        let radius = journal.value.abs();
        let product = radius * value;
        let error = radius * bound + journal.error * (value + bound) + U * product;
        finite(Answer::Scalar { value: product, bound: error })
    }

    fn transmission(&self, coupler: LinkId, output: LinkId) -> Read {
        let m = &self.model.mechanism;
        let pin = m.links[coupler.0].points.iter().find(|p| m.links[output.0].points.contains(p));
        let Some(pin) = pin.filter(|_| coupler != output) else {
            return undefined(format!(
                "links {} and {} have no common pin",
                self.number(coupler),
                self.number(output)
            ));
        };
        let mut arms = [[Site { body: 0, own: [super::constraints::Num::Exact(0.0); 2] }; 2]; 2];
        for (slot, link) in arms.iter_mut().zip([coupler, output]) {
            let Some(end) = self.other_end(link, *pin) else {
                return undefined(format!("link {} has no second end", self.number(link)));
            };
            *slot = self.ends(link, end, *pin)?;
        }
        self.scalar(0, 1.0, |s| {
            let [first, second] = [arm(s, &arms[0]), arm(s, &arms[1])];
            let cross = dot(quarter(first), second).v;
            cross.abs().atan2(dot(first, second).v)
        })
    }

    /// The other end of a link: its fixed point, else its first other pin, else its first other point.
    fn other_end(&self, link: LinkId, pin: PointId) -> Option<PointId> {
        let m = &self.model.mechanism;
        let others = || m.links[link.0].points.iter().copied().filter(|p| *p != pin);
        others()
            .find(|p| m.is_fixed(*p))
            .or_else(|| others().find(|p| m.points[p.0].links.len() > 1))
            .or_else(|| others().next())
    }

    // --- instant centres ---

    /// The place at which two links have the same velocity. A common pin, or the normal of a sliding pair,
    /// is the centre whatever moves; else it is solved from zero relative velocity.
    fn centre(&self, a: LinkId, b: LinkId) -> Read {
        if self.order < Order::Velocity {
            return undefined("only positions were solved");
        }
        if a == b {
            return undefined("a link has no motion against itself");
        }
        let m = &self.model.mechanism;
        let has = |link: LinkId, point: usize| self.model.sites[point].iter().any(|s| s.body == link.0);
        if let Some(pin) = (0..m.points.len()).find(|p| has(a, *p) && has(b, *p)) {
            return self.position(PointId(pin));
        }
        for (index, slide) in m.slides.iter().enumerate() {
            let rider = match slide.rider {
                Rider::Pin { block, .. } => block,
                Rider::Link { link, .. } => Some(link),
            };
            let joined = rider.is_some_and(|rider| {
                [rider, slide.guide.link] == [a, b] || [slide.guide.link, rider] == [a, b]
            });
            match self.model.track(index) {
                Some(Track::Line(line)) if joined => {
                    let bearing = self.read(0, None, |s| {
                        let [x, y] = s.direction(line);
                        [x.v, y.v, y.v.atan2(x.v)]
                    })?;
                    return Ok(at_infinity([-bearing[1].value, bearing[0].value], bearing[2].bound));
                }
                Some(Track::Arc(arc)) if joined => {
                    return self.place(self.read(0, None, |s| parts(s.site(&arc.centre), 0))?);
                }
                _ => {}
            }
        }
        let solved: Option<&Solved> = self.unit.as_ref().or(self.solved.as_ref());
        let [omega, vx, vy] = self.read(1, solved, |s| {
            let (omega, v) = against(s, a, b);
            [omega, v[0], v[1]]
        })?;
        if omega.value.abs() > ZERO * omega.bound {
            // c = o + (−V_y, V_x)/ω, o the origin of the first link.
            return self.place(self.read(1, solved, |s| {
                let (omega, v) = against(s, a, b);
                let origin = parts(s.origin(a.0), 0);
                [origin[0] - v[1] / omega, origin[1] + v[0] / omega]
            })?);
        }
        let speed = libm::hypot(vx.value, vy.value);
        if speed <= ZERO * libm::hypot(vx.bound, vy.bound) {
            return undefined(format!(
                "links {} and {} do not move against each other",
                self.number(a),
                self.number(b)
            ));
        }
        let [bearing] = self.read(1, solved, |s| {
            let (_, v) = against(s, a, b);
            [v[1].atan2(v[0])]
        })?;
        Ok(at_infinity([-vy.value / speed, vx.value / speed], bearing.bound))
    }
}

/// A place of the mechanism at this instant.
#[derive(Debug, Clone, Copy)]
enum Spot {
    /// A point of a body.
    Site(Site),
    /// Where two bodies roll on each other.
    Contact(Contact),
}

impl Spot {
    fn place<'t>(&self, s: &Scope<'t>) -> Vector<'t> {
        match self {
            Self::Site(site) => s.site(site),
            Self::Contact(Contact::Circles { centres, radii, internal }) => {
                // On the first circle: towards the other centre, but away from it inside a larger one.
                let [first, second] = centres.map(|centre| s.site(&centre));
                let along = minus(second, first);
                let [own, other] = s.pair(*radii);
                let inside = *internal && own.value() < other.value();
                let part = if inside { -own } else { own } / dot(along, along).sqrt();
                plus(first, along.map(|coordinate| coordinate * part))
            }
            Self::Contact(Contact::Line { centre, line }) => {
                let away = s.above(centre, line);
                let normal = quarter(s.direction(line));
                minus(s.site(centre), normal.map(|coordinate| coordinate * away))
            }
        }
    }
}

/// From the second site to the first, both of one body: its own vector, turned.
fn arm<'t>(s: &Scope<'t>, ends: &[Site; 2]) -> Vector<'t> {
    let own = |site: &Site| site.own.map(|c| s.num(c));
    let along = minus(own(&ends[0]), own(&ends[1]));
    if ends[0].body == 0 { along } else { turned(along, s.angle(ends[0].body)) }
}

/// Angular velocity of the first link against the second, and its velocity against the second at the
/// origin of the first.
fn against<'t>(s: &Scope<'t>, a: LinkId, b: LinkId) -> (Var<'t>, [Var<'t>; 2]) {
    let origin = s.origin(a.0);
    let relative = difference(parts(origin, 1), parts(s.carried(b.0, origin), 1));
    (s.angle(a.0).d - s.angle(b.0).d, relative)
}

/// Velocity of a pin against the material point of a link under it.
fn slip_velocity<'t>(s: &Scope<'t>, site: &Site, link: LinkId) -> [Var<'t>; 2] {
    let place = s.site(site);
    difference(parts(place, 1), parts(s.carried(link.0, place), 1))
}

/// 2 ω × slip.
fn coriolis<'t>(s: &Scope<'t>, slip: [Var<'t>; 2], link: LinkId) -> [Var<'t>; 2] {
    let twice = s.angle(link.0).d * s.tape.constant(2.0);
    [-(slip[1] * twice), slip[0] * twice]
}

/// Acceleration of a pin against the link under it, without Coriolis's.
fn slip_acceleration<'t>(s: &Scope<'t>, site: &Site, link: LinkId) -> [Var<'t>; 2] {
    let place = s.site(site);
    let absolute = difference(parts(place, 2), parts(s.carried(link.0, place), 2));
    difference(absolute, coriolis(s, slip_velocity(s, site, link), link))
}

fn vector(m: [Measured; 2], unit: f64) -> Read {
    finite(Answer::Vector {
        value: m.map(|c| c.value * unit),
        bound: libm::hypot(m[0].bound, m[1].bound) * unit,
    })
}

fn at_infinity(direction: [f64; 2], bound: f64) -> Answer {
    Answer::AtInfinity { direction, bound: bound + 4.0 * U }
}

/// Passes an answer whose numbers are finite in SI units.
fn finite(answer: Answer) -> Read {
    let fine = match &answer {
        Answer::Scalar { value, bound } => value.is_finite() && bound.is_finite(),
        Answer::Vector { value, bound } => value.iter().all(|v| v.is_finite()) && bound.is_finite(),
        Answer::AtInfinity { .. } | Answer::Indeterminate(_) => true,
    };
    if fine { Ok(answer) } else { Err(Indeterminate::Singular) }
}
