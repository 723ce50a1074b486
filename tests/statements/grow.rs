//! Random mechanisms, grown group by group over places that are chosen first.

use super::mechanism::{
    Contact, Driver, FRAME, Input, Kind, Mechanism, Path, Place, Rider, Roll, Slide, direction, left, length,
    minus, plus, unit,
};
use crate::extremes::dice::Dice;

/// Points nearer to each other than this are no joints of one mechanism.
const APART: f64 = 0.7;

/// Whether a pin on two guides may have neither a link nor a block: the contract does not say that it is a point.
const OWNERLESS_PINS: bool = false;

/// Grows one mechanism.
struct Grower<'a> {
    dice: &'a mut Dice,
    m: Mechanism,
    /// Places on a lattice, directions by 45°.
    regular: bool,
    /// What has grown, for the tables.
    made: Vec<&'static str>,
}

/// No room for a group.
struct NoRoom;

type Grown = Result<(), NoRoom>;

/// A mechanism, and the names of its groups.
pub(crate) struct Growth {
    pub(crate) mechanism: Mechanism,
    pub(crate) made: Vec<&'static str>,
}

impl Dice {
    /// One of so many.
    pub(crate) fn below(&mut self, n: usize) -> usize {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "from 0 to n")]
        let i = (self.roll() * n as f64) as usize;
        i.min(n - 1)
    }

    /// One of these.
    pub(crate) fn of<T: Copy>(&mut self, these: &[T]) -> T {
        these[self.below(these.len())]
    }

    /// Another order.
    pub(crate) fn shuffle<T>(&mut self, these: &mut [T]) {
        for i in (1..these.len()).rev() {
            let j = self.below(i + 1);
            these.swap(i, j);
        }
    }
}

impl Grower<'_> {
    fn free(&self, at: Place) -> bool {
        self.m.points.iter().all(|p| length(minus(p.at, at)) > APART)
    }

    fn somewhere(&mut self) -> Result<Place, NoRoom> {
        for _ in 0..40 {
            let mut at = [self.dice.between(-5.0, 5.0), self.dice.between(-5.0, 5.0)];
            let step = if self.regular { 1.0 } else { 0.01 };
            at = at.map(|x| (x / step).round() * step);
            if self.free(at) {
                return Ok(at);
            }
        }
        Err(NoRoom)
    }

    fn some_direction(&mut self) -> Place {
        let eighth = std::f64::consts::FRAC_PI_4;
        if self.regular {
            #[expect(clippy::cast_precision_loss, reason = "0 to 7")]
            let n = self.dice.below(8) as f64;
            // Axes are exact.
            let d = direction(n * eighth);
            d.map(|x| {
                if x.abs() < 1e-9 {
                    0.0
                } else if (x.abs() - 1.0).abs() < 1e-9 {
                    x.signum()
                } else {
                    x
                }
            })
        } else {
            direction(self.dice.between(-3.1, 3.1))
        }
    }

    fn along(&mut self, from: Place, way: Place) -> Result<Place, NoRoom> {
        for _ in 0..20 {
            let mut t = self.dice.between(1.0, 5.0) * self.dice.side();
            if self.regular {
                t = t.round();
            }
            let at = plus(from, way, t);
            if self.free(at) {
                return Ok(at);
            }
        }
        Err(NoRoom)
    }

    fn link(&mut self) -> usize {
        self.m.body(Kind::Link)
    }

    fn fixed(&mut self) -> Result<usize, NoRoom> {
        let at = self.somewhere()?;
        Ok(self.m.point(FRAME, at))
    }

    /// A moving point to which something may be pinned.
    fn moving(&mut self) -> Result<usize, NoRoom> {
        let all: Vec<usize> = (0..self.m.points.len())
            .filter(|p| {
                !self.m.is_fixed(*p)
                    && self.m.points[*p].of.len() < 4
                    && self.m.points[*p].of.iter().all(|b| self.m.bodies[*b].kind != Kind::Particle)
            })
            .collect();
        if all.is_empty() { Err(NoRoom) } else { Ok(self.dice.of(&all)) }
    }

    /// A fixed point, or one of another link than those of `p`.
    fn other(&mut self, p: usize) -> Result<usize, NoRoom> {
        if self.dice.chance(0.65) {
            if self.dice.chance(0.15) {
                let fixed: Vec<usize> = (0..self.m.points.len()).filter(|p| self.m.is_fixed(*p)).collect();
                if !fixed.is_empty() {
                    return Ok(self.dice.of(&fixed));
                }
            }
            return self.fixed();
        }
        for _ in 0..8 {
            let q = self.moving()?;
            if q != p && !self.m.points[q].of.iter().any(|b| self.m.points[p].of.contains(b)) {
                return Ok(q);
            }
        }
        self.fixed()
    }

    /// The frame, or a moving link with two points at least that has not this point.
    fn carrier(&mut self, p: usize) -> usize {
        if self.dice.chance(0.6) {
            return FRAME;
        }
        let all: Vec<usize> = (1..self.m.bodies.len())
            .filter(|b| {
                self.m.bodies[*b].kind == Kind::Link
                    && self.m.bodies[*b].joins.len() > 1
                    && !self.m.points[p].of.contains(b)
            })
            .collect();
        if all.is_empty() { FRAME } else { self.dice.of(&all) }
    }

    /// A guide of a body that passes a place.
    fn guide(&mut self, on: usize, at: Place) -> Path {
        let along = self.some_direction();
        // Now and then through a point of the body.
        if self.dice.chance(0.4) {
            let points: Vec<usize> = (0..self.m.points.len())
                .filter(|p| self.m.points[*p].of.contains(&on) && length(minus(self.m.at(*p), at)) > APART)
                .collect();
            if !points.is_empty() {
                let through = self.m.at(self.dice.of(&points));
                return Path::Line { through, along: unit(minus(at, through)) };
            }
        }
        let away = self.dice.between(-3.0, 3.0);
        let away = if self.regular { away.round() } else { away };
        Path::Line { through: plus(at, along, away), along }
    }

    fn pin_in_block(&mut self, point: usize, on: usize, path: Path) {
        let block = self.m.body(Kind::Block);
        self.m.join(block, point);
        self.m.slides.push(Slide {
            rider: Rider::Pin { point, block: Some(block) },
            on,
            path,
            swivel: false,
        });
    }

    fn rides(&mut self, link: usize, on: usize, path: Path, swivel: bool) {
        self.m.slides.push(Slide { rider: Rider::Link(link), on, path, swivel });
    }

    /// A link with a pin and a new end.
    fn rod(&mut self, from: usize) -> Result<(usize, usize), NoRoom> {
        let at = self.somewhere()?;
        let link = self.link();
        self.m.join(link, from);
        let end = self.m.point(link, at);
        Ok((link, end))
    }

    fn crank(&mut self) -> Result<Driver, NoRoom> {
        let o = self.fixed()?;
        let (link, _) = self.rod(o)?;
        Ok(Driver::Link(link))
    }

    /// An arm, a planet, a sun, and perhaps a ring that stands or turns.
    fn epicyclic(&mut self) -> Result<Vec<Driver>, NoRoom> {
        let o = self.fixed()?;
        let (arm, c) = self.rod(o)?;
        let apart = length(minus(self.m.at(c), self.m.at(o)));
        let planet = self.link();
        self.m.join(planet, c);
        let sun = self.link();
        self.m.join(sun, o);
        let mut wheels = vec![planet, sun];
        let r = (apart * self.dice.between(0.25, 0.7) * 10.0).round() / 10.0;
        let s = apart - r;
        let mesh = |bodies, radii, internal| Roll {
            bodies,
            contact: Contact::Wheels { centres: [o, c], radii, internal },
            keeps_distance: false,
        };
        self.m.rolls.push(mesh([sun, planet], [r, s], false));
        let mut drivers = vec![arm, sun];
        match self.dice.below(3) {
            0 => {}
            1 => {
                self.m.rolls.push(mesh([FRAME, planet], [apart + s, s], true));
                drivers.push(planet);
                self.dice.shuffle(&mut drivers);
                drivers.truncate(1);
            }
            _ => {
                let ring = self.link();
                self.m.join(ring, o);
                wheels.push(ring);
                self.m.rolls.push(mesh([ring, planet], [apart + s, s], true));
                drivers.push(ring);
                self.dice.shuffle(&mut drivers);
                drivers.truncate(2);
            }
        }
        for wheel in wheels {
            if self.dice.chance(0.6) {
                let at = self.somewhere()?;
                self.m.point(wheel, at);
            }
        }
        self.made.push("epicyclic");
        if !drivers.contains(&arm) {
            self.made.push("led-by-wheels");
        }
        Ok(drivers.into_iter().map(Driver::Link).collect())
    }

    /// Something that moves, and how it is driven.
    fn base(&mut self) -> Result<Vec<Driver>, NoRoom> {
        if self.dice.chance(0.05) {
            return self.epicyclic();
        }
        self.base_of_one().map(|driver| vec![driver])
    }

    /// Something that moves with one degree of freedom, and how it is driven.
    fn base_of_one(&mut self) -> Result<Driver, NoRoom> {
        match self.dice.below(100) {
            0..58 => self.crank(),
            58..68 => {
                self.made.push("riding-base");
                let at = self.somewhere()?;
                let link = self.link();
                self.m.point(link, at);
                let more = self.somewhere()?;
                self.m.point(link, more);
                let path = self.guide(FRAME, at);
                self.rides(link, FRAME, path, false);
                Ok(Driver::Slide(self.m.slides.len() - 1))
            }
            68..82 => {
                self.made.push("trammel");
                let link = self.link();
                let first = self.m.slides.len();
                for _ in 0..2 {
                    let at = self.somewhere()?;
                    let p = self.m.point(link, at);
                    let path = self.guide(FRAME, at);
                    self.pin_in_block(p, FRAME, path);
                }
                Ok(if self.dice.chance(0.5) {
                    Driver::Link(link)
                } else {
                    Driver::Slide(first + self.dice.below(2))
                })
            }
            82..92 => {
                self.made.push("slider-base");
                let at = self.somewhere()?;
                let block = self.m.body(Kind::Block);
                let p = self.m.point(block, at);
                let path = self.guide(FRAME, at);
                self.m.slides.push(Slide {
                    rider: Rider::Pin { point: p, block: Some(block) },
                    on: FRAME,
                    path,
                    swivel: false,
                });
                let slide = self.m.slides.len() - 1;
                self.rrr_at(p)?;
                Ok(Driver::Slide(slide))
            }
            _ => {
                self.made.push("wheel-base");
                let at = self.somewhere()?;
                let link = self.link();
                let c = self.m.point(link, at);
                let more = self.somewhere()?;
                self.m.point(link, more);
                self.contact_with_plane(FRAME, link, c);
                Ok(Driver::Link(link))
            }
        }
    }

    fn contact_with_plane(&mut self, plane: usize, wheel: usize, centre: usize) {
        let along = self.some_direction();
        self.pitch_line(plane, wheel, centre, along, true);
    }

    fn pitch_line(&mut self, rack: usize, wheel: usize, centre: usize, along: Place, keeps_distance: bool) {
        let radius = (self.dice.between(0.5, 2.0) * 10.0).round() / 10.0;
        let foot = plus(self.m.at(centre), left(along), -radius * self.dice.side());
        let through = plus(foot, along, self.dice.between(-2.0, 2.0));
        self.m.rolls.push(Roll {
            bodies: [rack, wheel],
            contact: Contact::Rack { through, along, centre, radius },
            keeps_distance,
        });
    }

    fn rrr_at(&mut self, p: usize) -> Grown {
        let q = self.other(p)?;
        let (_, b) = self.rod(p)?;
        let link = self.link();
        self.m.join(link, q);
        self.m.join(link, b);
        Ok(())
    }

    fn rrp(&mut self) -> Grown {
        let p = self.moving()?;
        let on = self.carrier(p);
        let (_, b) = self.rod(p)?;
        let at = self.m.at(b);
        if self.dice.chance(0.65) {
            let path = self.guide(on, at);
            self.pin_in_block(b, on, path);
        } else {
            let link = self.link();
            let first = if self.dice.chance(0.4) {
                self.m.join(link, b);
                let more = self.somewhere()?;
                self.m.point(link, more);
                at
            } else {
                let c = self.somewhere()?;
                self.m.point(link, c);
                self.m.join(link, b);
                c
            };
            let path = self.guide(on, first);
            self.rides(link, on, path, false);
        }
        Ok(())
    }

    fn rpr(&mut self) -> Grown {
        let p = self.moving()?;
        let r = self.other(p)?;
        let (from, to) = (self.m.at(r), self.m.at(p));
        let way = unit(minus(to, from));
        match self.dice.below(4) {
            0 => {
                // A lever with a slot.
                let lever = self.link();
                self.m.join(lever, r);
                if self.dice.chance(0.5) {
                    let e = self.along(from, way)?;
                    self.m.point(lever, e);
                    self.pin_in_block(p, lever, Path::Line { through: from, along: way });
                } else {
                    let e = self.somewhere()?;
                    self.m.point(lever, e);
                    let path = self.guide(lever, to);
                    self.pin_in_block(p, lever, path);
                }
            }
            1 => {
                // A swivelling guide.
                let swivel = self.link();
                self.m.join(swivel, r);
                self.pin_in_block(p, swivel, Path::Line { through: from, along: way });
                self.m.slides.last_mut().unwrap().swivel = true;
            }
            2 => {
                // A rod in an oscillating cylinder.
                let rod = self.link();
                self.m.join(rod, p);
                let e = if self.dice.chance(0.5) { self.along(to, way)? } else { self.somewhere()? };
                self.m.point(rod, e);
                let cylinder = self.link();
                self.m.join(cylinder, r);
                let swivel = self.dice.chance(0.6);
                let path = if swivel {
                    Path::Line { through: from, along: way }
                } else {
                    let e = self.somewhere()?;
                    self.m.point(cylinder, e);
                    self.guide(cylinder, to)
                };
                self.rides(rod, cylinder, path, swivel);
            }
            _ => {
                // A bar that slides through a swivelling block.
                let bar = self.link();
                self.m.join(bar, p);
                let e = self.somewhere()?;
                self.m.point(bar, e);
                let block = self.link();
                self.m.join(block, r);
                if self.dice.chance(0.3) {
                    let e = self.somewhere()?;
                    self.m.point(block, e);
                }
                let path = self.guide(bar, from);
                self.rides(block, bar, path, false);
            }
        }
        Ok(())
    }

    fn prp(&mut self) -> Grown {
        let at = self.somewhere()?;
        let block = self.m.body(Kind::Block);
        let p = self.m.point(block, at);
        let a = self.carrier(p);
        let b = loop {
            let b = self.carrier(p);
            if b != a {
                break b;
            }
            if self.dice.chance(0.2) {
                return Err(NoRoom);
            }
        };
        let path = self.guide(a, at);
        self.m.slides.push(Slide {
            rider: Rider::Pin { point: p, block: Some(block) },
            on: a,
            path,
            swivel: false,
        });
        let path = self.guide(b, at);
        self.pin_in_block(p, b, path);
        Ok(())
    }

    fn yoke(&mut self) -> Grown {
        let p = self.moving()?;
        let on = self.carrier(p);
        let link = self.link();
        let c = self.somewhere()?;
        self.m.point(link, c);
        let d = self.somewhere()?;
        self.m.point(link, d);
        let path = self.guide(on, c);
        self.rides(link, on, path, false);
        let path = self.guide(link, self.m.at(p));
        self.pin_in_block(p, link, path);
        Ok(())
    }

    fn yoke_in_slot(&mut self) -> Grown {
        let p = self.moving()?;
        let a = self.m.points[p].of[0];
        if self.m.bodies[a].kind != Kind::Link {
            return Err(NoRoom);
        }
        let link = self.link();
        let c = self.somewhere()?;
        self.m.point(link, c);
        let at = self.somewhere()?;
        let b = self.m.point(link, at);
        let path = self.guide(FRAME, c);
        self.rides(link, FRAME, path, false);
        let path = self.guide(a, at);
        self.pin_in_block(b, a, path);
        Ok(())
    }

    fn oldham(&mut self) -> Grown {
        let p = self.moving()?;
        let a = self.m.points[p].of[0];
        if self.m.bodies[a].kind != Kind::Link || self.m.bodies[a].joins.len() < 2 {
            return Err(NoRoom);
        }
        let o = self.fixed()?;
        let middle = self.link();
        let c = self.somewhere()?;
        self.m.point(middle, c);
        let e = self.somewhere()?;
        self.m.point(middle, e);
        let path = self.guide(a, c);
        self.rides(middle, a, path, false);
        let disc = self.link();
        self.m.join(disc, o);
        let from = self.m.at(o);
        if self.dice.chance(0.5) {
            let along = unit(minus(c, from));
            self.rides(middle, disc, Path::Line { through: from, along }, true);
        } else {
            let b = self.somewhere()?;
            self.m.point(disc, b);
            let path = self.guide(disc, c);
            self.rides(middle, disc, path, false);
        }
        Ok(())
    }

    fn arc(&mut self) -> Grown {
        let p = self.moving()?;
        let on = self.carrier(p);
        let (_, b) = self.rod(p)?;
        let at = self.m.at(b);
        let path = self.arc_through(on, at)?;
        self.pin_in_block(b, on, path);
        Ok(())
    }

    fn arc_through(&mut self, on: usize, at: Place) -> Result<Path, NoRoom> {
        let points: Vec<usize> = (0..self.m.points.len())
            .filter(|p| self.m.points[*p].of.contains(&on) && length(minus(self.m.at(*p), at)) > APART)
            .collect();
        let (centre, point) = if !points.is_empty() && self.dice.chance(0.5) {
            let p = self.dice.of(&points);
            (self.m.at(p), Some(p))
        } else {
            (self.somewhere()?, None)
        };
        Ok(Path::Arc { centre, point, radius: length(minus(at, centre)) })
    }

    fn yoke_with_arc(&mut self) -> Grown {
        let p = self.moving()?;
        let link = self.link();
        let c = self.somewhere()?;
        self.m.point(link, c);
        let d = self.somewhere()?;
        self.m.point(link, d);
        let path = self.guide(FRAME, c);
        self.rides(link, FRAME, path, false);
        let path = self.arc_through(link, self.m.at(p))?;
        self.pin_in_block(p, link, path);
        Ok(())
    }

    /// A link that turns about a fixed point, and that point.
    fn pivoted(&mut self) -> Result<(usize, usize), NoRoom> {
        let all: Vec<(usize, usize)> = (1..self.m.bodies.len())
            .filter(|b| self.m.bodies[*b].kind == Kind::Link && self.m.bodies[*b].joins.len() > 1)
            .filter_map(|b| Some((b, *self.m.bodies[b].joins.iter().find(|p| self.m.is_fixed(**p))?)))
            .collect();
        if all.is_empty() { Err(NoRoom) } else { Ok(self.dice.of(&all)) }
    }

    fn radii(&mut self, apart: f64) -> ([f64; 2], bool) {
        if self.dice.chance(0.6) {
            if self.dice.chance(0.4) {
                // As of 20 and 30 teeth.
                #[expect(clippy::cast_precision_loss, reason = "few teeth")]
                let [z, y] = [self.dice.below(40) + 12, self.dice.below(40) + 12].map(|z| z as f64);
                return ([apart * z / (z + y), apart * y / (z + y)], false);
            }
            let r = apart * self.dice.between(0.25, 0.75);
            ([r, apart - r], false)
        } else {
            let s = apart * self.dice.between(0.3, 1.5);
            let both = if self.dice.chance(0.5) { [apart + s, s] } else { [s, apart + s] };
            (both, true)
        }
    }

    fn gear(&mut self) -> Grown {
        let (a, o) = self.pivoted()?;
        let q = self.fixed()?;
        let wheel = self.link();
        self.m.join(wheel, q);
        if self.dice.chance(0.7) {
            let at = self.somewhere()?;
            self.m.point(wheel, at);
        }
        let (radii, internal) = self.radii(length(minus(self.m.at(q), self.m.at(o))));
        let contact = Contact::Wheels { centres: [o, q], radii, internal };
        self.m.rolls.push(Roll { bodies: [a, wheel], contact, keeps_distance: false });
        Ok(())
    }

    fn planet(&mut self) -> Grown {
        let (a, o) = self.pivoted()?;
        let ends: Vec<usize> =
            self.m.bodies[a].joins.iter().copied().filter(|p| !self.m.is_fixed(*p)).collect();
        if ends.is_empty() {
            return Err(NoRoom);
        }
        let c = self.dice.of(&ends);
        let wheel = self.link();
        self.m.join(wheel, c);
        if self.dice.chance(0.7) {
            let at = self.somewhere()?;
            self.m.point(wheel, at);
        }
        let (radii, internal) = self.radii(length(minus(self.m.at(c), self.m.at(o))));
        let contact = Contact::Wheels { centres: [o, c], radii, internal };
        self.m.rolls.push(Roll { bodies: [FRAME, wheel], contact, keeps_distance: false });
        Ok(())
    }

    fn wheel_on_rod(&mut self) -> Grown {
        let p = self.moving()?;
        let on = self.carrier(p);
        let (_, c) = self.rod(p)?;
        let wheel = self.link();
        self.m.join(wheel, c);
        if self.dice.chance(0.5) {
            let at = self.somewhere()?;
            self.m.point(wheel, at);
        }
        if self.dice.chance(0.6) {
            self.contact_with_plane(on, wheel, c);
        } else {
            let o = self.fixed()?;
            let (radii, internal) = self.radii(length(minus(self.m.at(c), self.m.at(o))));
            let contact = Contact::Wheels { centres: [o, c], radii, internal };
            self.m.rolls.push(Roll { bodies: [FRAME, wheel], contact, keeps_distance: true });
        }
        Ok(())
    }

    fn rack(&mut self) -> Grown {
        let (a, o) = self.pivoted()?;
        let rack = self.link();
        let b = self.somewhere()?;
        self.m.point(rack, b);
        let e = self.somewhere()?;
        self.m.point(rack, e);
        let Path::Line { through, along } = self.guide(FRAME, b) else { return Err(NoRoom) };
        self.rides(rack, FRAME, Path::Line { through, along }, false);
        self.pitch_line(rack, a, o, along, false);
        Ok(())
    }

    fn rack_on_crank(&mut self) -> Grown {
        let p = self.moving()?;
        let o = self.fixed()?;
        let (rack, _) = self.rod(p)?;
        let pinion = self.link();
        self.m.join(pinion, o);
        if self.dice.chance(0.6) {
            let at = self.somewhere()?;
            self.m.point(pinion, at);
        }
        self.contact_with_plane(rack, pinion, o);
        Ok(())
    }

    /// A rack in a guide of an arm, moved by the planet on that arm.
    fn rack_on_arm(&mut self) -> Grown {
        let planets: Vec<(usize, usize)> = self
            .m
            .rolls
            .iter()
            .filter_map(|roll| match roll.contact {
                Contact::Wheels { centres, .. } if !roll.keeps_distance => Some((roll.bodies[1], centres[1])),
                _ => None,
            })
            .filter(|(_, c)| !self.m.is_fixed(*c))
            .collect();
        if planets.is_empty() {
            return Err(NoRoom);
        }
        let (planet, c) = self.dice.of(&planets);
        let arm = self.m.points[c].of[0];
        if arm == planet {
            return Err(NoRoom);
        }
        let rack = self.link();
        let b = self.somewhere()?;
        self.m.point(rack, b);
        let e = self.somewhere()?;
        self.m.point(rack, e);
        let Path::Line { through, along } = self.guide(arm, b) else { return Err(NoRoom) };
        self.rides(rack, arm, Path::Line { through, along }, false);
        self.pitch_line(rack, planet, c, along, false);
        Ok(())
    }

    /// A gear about a moving point of a link, and one that rolls on it at the end of a rocker.
    fn eccentric(&mut self) -> Grown {
        let p = self.moving()?;
        let a = self.m.points[p].of[0];
        if self.m.bodies[a].kind != Kind::Link {
            return Err(NoRoom);
        }
        let o = self.other(p)?;
        let (_, b) = self.rod(o)?;
        let wheel = self.link();
        self.m.join(wheel, b);
        if self.dice.chance(0.4) {
            let at = self.somewhere()?;
            self.m.point(wheel, at);
        }
        let (radii, internal) = self.radii(length(minus(self.m.at(b), self.m.at(p))));
        let contact = Contact::Wheels { centres: [p, b], radii, internal };
        self.m.rolls.push(Roll { bodies: [a, wheel], contact, keeps_distance: true });
        Ok(())
    }

    fn group(&mut self) -> Grown {
        type Group<'a> = (usize, &'static str, fn(&mut Grower<'a>) -> Grown);
        let groups: [Group; 16] = [
            (20, "rrr", |g| {
                let p = g.moving()?;
                g.rrr_at(p)
            }),
            (18, "rrp", Self::rrp),
            (22, "rpr", Self::rpr),
            (5, "prp", Self::prp),
            (6, "yoke", Self::yoke),
            (4, "yoke-in-slot", Self::yoke_in_slot),
            (5, "oldham", Self::oldham),
            (5, "arc", Self::arc),
            (3, "yoke-with-arc", Self::yoke_with_arc),
            (4, "gear", Self::gear),
            (4, "planet", Self::planet),
            (4, "wheel-on-rod", Self::wheel_on_rod),
            (3, "rack", Self::rack),
            (3, "rack-on-crank", Self::rack_on_crank),
            (3, "rack-on-arm", Self::rack_on_arm),
            (3, "eccentric", Self::eccentric),
        ];
        let all: usize = groups.iter().map(|g| g.0).sum();
        let mut n = self.dice.below(all);
        for (weight, name, grow) in groups {
            if n < weight {
                let before = (self.m.clone(), self.made.len());
                if grow(self).is_err() {
                    self.m = before.0;
                    self.made.truncate(before.1);
                    return Err(NoRoom);
                }
                self.made.push(name);
                return Ok(());
            }
            n -= weight;
        }
        Err(NoRoom)
    }

    /// Points of interest.
    fn interest(&mut self, part: f64) {
        for body in 1..self.m.bodies.len() {
            let joins = self.m.bodies[body].joins.clone();
            if self.m.bodies[body].kind != Kind::Link || joins.len() < 2 || !self.dice.chance(part) {
                continue;
            }
            let (a, b) = (self.m.at(joins[0]), self.m.at(joins[1]));
            let at = if self.dice.chance(0.3) { self.along(a, unit(minus(b, a))) } else { self.somewhere() };
            if let Ok(at) = at {
                self.m.point(body, at);
            }
        }
    }
}

/// Takes away blocks of pins that something else holds, and the last block of a pin without a link.
fn bare(m: &mut Mechanism, dice: &mut Dice, part: f64, ownerless: bool) {
    for i in 0..m.slides.len() {
        let Rider::Pin { point, block: Some(block) } = m.slides[i].rider else { continue };
        if matches!(m.slides[i].path, Path::Arc { .. }) && dice.chance(0.5) || !dice.chance(part) {
            continue;
        }
        if m.points[point].of.len() == 1 && !ownerless {
            continue;
        }
        if m.points[point].of.len() > 1 {
            m.points[point].of.retain(|b| *b != block);
            m.bodies[block].joins.clear();
        } else {
            m.bodies[block].kind = Kind::Particle;
        }
        m.slides[i].rider = Rider::Pin { point, block: None };
    }
    // Bodies that have gone.
    let mut now = vec![usize::MAX; m.bodies.len()];
    let mut bodies = Vec::new();
    for (old, body) in m.bodies.iter().enumerate() {
        let used = old == FRAME || m.points.iter().any(|p| p.of.contains(&old));
        if used {
            now[old] = bodies.len();
            bodies.push(body.clone());
        }
    }
    m.bodies = bodies;
    for p in &mut m.points {
        p.of.iter_mut().for_each(|b| *b = now[*b]);
        // A link before a block: the first carries the point.
        p.of.sort_by_key(|b| (m.bodies[*b].kind == Kind::Block, *b));
    }
    for s in &mut m.slides {
        s.on = now[s.on];
        match &mut s.rider {
            Rider::Pin { block: Some(b), .. } | Rider::Link(b) => *b = now[*b],
            Rider::Pin { block: None, .. } => {}
        }
    }
    for r in &mut m.rolls {
        r.bodies = r.bodies.map(|b| now[b]);
    }
    for i in &mut m.inputs {
        if let Driver::Link(b) = &mut i.driver {
            *b = now[*b];
        }
    }
}

fn speed(dice: &mut Dice) -> (f64, f64) {
    let round = |x: f64| (x * 100.0).round() / 100.0;
    let rate = round(dice.between(0.5, 9.0) * dice.side());
    let second = round(dice.between(0.5, 20.0) * dice.side());
    match dice.below(12) {
        0 => (0.0, second),
        1..6 => (rate, 0.0),
        _ => (rate, second),
    }
}

/// Whether a slide can be named as what drives.
fn drivable(m: &Mechanism, slide: usize) -> bool {
    let s = &m.slides[slide];
    let same = m.slides.iter().filter(|o| m.rider(o).0 == m.rider(s).0).count();
    let named = match s.rider {
        Rider::Pin { block, .. } => same == 1 || block.is_some(),
        Rider::Link(_) => same == 1,
    };
    named && matches!(s.path, Path::Line { .. })
}

/// A mechanism; `None` where nothing fits.
pub(crate) fn grow(dice: &mut Dice) -> Option<Growth> {
    let regular = dice.chance(0.3);
    let mut g = Grower { dice, m: Mechanism::new(), regular, made: vec![] };
    let mut drivers = g.base().ok()?;
    if g.dice.chance(0.12) {
        drivers.extend(g.base().ok()?);
    }
    g.interest(0.35);
    let groups = g.dice.of(&[0, 1, 1, 1, 1, 2, 2, 2, 3, 4]);
    for _ in 0..groups {
        // What finds no room is left out.
        let _ = g.group();
    }
    g.interest(0.4);
    let made = g.made.clone();
    let mut m = g.m;
    for driver in drivers {
        let (rate, second) = speed(dice);
        m.inputs.push(Input { driver, rate, second });
    }
    let part = dice.of(&[0.0, 0.5, 0.5, 1.0]);
    bare(&mut m, dice, part, OWNERLESS_PINS);
    let mut made = made;
    // Another link or slide drives instead.
    if dice.chance(0.25) {
        let mut all: Vec<Driver> =
            (0..m.slides.len()).filter(|s| drivable(&m, *s)).map(Driver::Slide).collect();
        all.extend((1..m.bodies.len()).filter(|b| m.bodies[*b].kind == Kind::Link).map(Driver::Link));
        let other = dice.of(&all);
        if m.inputs.iter().all(|i| i.driver != other) {
            let which = dice.below(m.inputs.len());
            m.inputs[which].driver = other;
            made.push("driven-elsewhere");
        }
    }
    if m.inputs.iter().any(|i| matches!(i.driver, Driver::Slide(s) if !drivable(&m, s))) {
        return None;
    }
    let mut numbers: Vec<u32> = (2..=u32::try_from(m.bodies.len()).unwrap()).collect();
    if dice.chance(0.4) {
        dice.shuffle(&mut numbers);
    }
    for (body, number) in m.bodies.iter_mut().skip(1).zip(numbers) {
        body.number = number;
    }
    let scale = dice.of(&[1.0, 1.0, 10.0, 37.0, 0.01]);
    let (turn, shift) = if dice.chance(0.3) {
        (dice.between(-3.0, 3.0), [dice.between(-9.0, 9.0) * scale, dice.between(-9.0, 9.0) * scale])
    } else {
        (0.0, [0.0, 0.0])
    };
    let mirror = dice.chance(0.2);
    let mut m = m.moved(mirror, turn, scale, shift);
    for i in &mut m.inputs {
        if matches!(i.driver, Driver::Slide(_)) {
            i.rate *= scale;
            i.second *= scale;
        }
    }
    Some(Growth { mechanism: m, made })
}
