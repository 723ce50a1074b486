//! How the field writes points, images, vectors and directions.

use super::human;
use super::profile::{Profile, Relative};
use super::rich::Rich;
use super::words::Words;
use crate::graphical::construction::{Claim, Label, Reference};
use crate::mechanism::quantity::{DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::{Direction, GuidePoint, LinkId, Mechanism, Path, PointId, Rider};
use crate::scene::{AngularAcceleration, Scene};
use crate::sheet::font::Face;

/// The notation of one scene in one language.
#[derive(Debug, Clone, Copy)]
pub struct Notation<'a> {
    /// The scene.
    pub scene: &'a Scene,
    /// The words.
    pub words: &'static Words,
    /// How vectors are written.
    pub profile: &'static Profile,
}

impl<'a> Notation<'a> {
    /// The notation that a scene chooses.
    #[must_use]
    pub fn new(scene: &'a Scene, words: &'static Words) -> Self {
        Self { scene, words, profile: Profile::named(scene.sheet.notation.as_deref()) }
    }

    /// The mechanism.
    #[must_use]
    pub fn mechanism(&self) -> &'a Mechanism {
        &self.scene.mechanism
    }

    /// The name of a point as the scene writes it; a point that is not there has none.
    #[must_use]
    pub fn point_name(&self, point: PointId) -> &'a str {
        self.mechanism().points.get(point.0).map_or("", |p| p.name.as_str())
    }

    /// The number of a link.
    #[must_use]
    pub fn number(&self, link: LinkId) -> String {
        self.mechanism().links.get(link.0).map_or_else(String::new, |l| l.number.to_string())
    }

    /// The number of a link as the index of its point under a pin: in parentheses where the scene has a point of that name, for A₄
    /// is then that one.
    #[must_use]
    pub fn number_under(&self, point: PointId, link: LinkId) -> String {
        let number = self.number(link);
        let taken = self.mechanism().point_named(&format!("{}{number}", self.point_name(point))).is_some();
        if taken { format!("({number})") } else { number }
    }

    /// A point on the skeleton and in text: O₂, A.
    #[must_use]
    pub fn point(&self, point: PointId) -> Rich {
        let (letters, index) = split(self.point_name(point));
        Rich::italic(letters).sub(index)
    }

    /// A point with a further index: A with w, O with 2w.
    #[must_use]
    pub fn point_with(&self, point: PointId, more: &str) -> Rich {
        let (letters, index) = split(self.point_name(point));
        Rich::italic(letters).sub(&format!("{index}{more}"))
    }

    /// A point in another position: A′.
    #[must_use]
    pub fn point_primed(&self, point: PointId) -> Rich {
        let (letters, index) = split(self.point_name(point));
        Rich::italic(letters).scripts("′", Face::Italic, index)
    }

    /// A length by its ends: O₂A.
    #[must_use]
    pub fn length(&self, from: PointId, to: PointId) -> Rich {
        self.point(from).then(&self.point(to))
    }

    /// What stands side by side in a sentence: A; A and B; A, B and C.
    #[must_use]
    pub fn list(&self, parts: &[Rich]) -> Rich {
        match parts.split_last() {
            Some((last, rest)) if !rest.is_empty() => {
                Rich::join(rest, &Rich::upright(self.words.comma)).up(self.words.and).then(last)
            }
            _ => Rich::join(parts, &Rich::default()),
        }
    }

    /// Links in a sentence: link 3; links 3 and 4.
    #[must_use]
    pub fn links(&self, links: &[LinkId]) -> Rich {
        let numbers: Vec<Rich> = links.iter().map(|l| Rich::upright(self.number(*l))).collect();
        let template = match links {
            [_] => self.words.link,
            [_, _] => self.words.two_links,
            _ => self.words.links,
        };
        let list = self.list(&numbers);
        Rich::fill(template, &[("links", list)])
    }

    /// An image point in a vector diagram: o, b, a₄, b′₁.
    #[must_use]
    pub fn image(&self, label: Label, kind: DiagramKind) -> Rich {
        let prime = if kind == DiagramKind::Acceleration { self.profile.prime } else { "" };
        let (letters, sub) = self.image_parts(label);
        let letters = match label {
            Label::Pole => {
                let (letter, index) = self.profile.poles[usize::from(kind == DiagramKind::Acceleration)];
                let prime = if index.is_empty() { prime } else { "" };
                return Rich::italic(letter).scripts(prime, Face::Italic, index);
            }
            _ if self.profile.capital_images => letters.to_uppercase(),
            _ => letters,
        };
        Rich::italic(letters).scripts(prime, Face::Italic, &sub)
    }

    /// The same as plain characters, for data attributes: o, b, a4, b'1.
    #[must_use]
    pub fn image_name(&self, label: Label, kind: DiagramKind) -> String {
        let prime = if kind == DiagramKind::Acceleration { "'" } else { "" };
        let (letters, sub) = self.image_parts(label);
        format!("{letters}{prime}{sub}")
    }

    fn image_parts(&self, label: Label) -> (String, String) {
        let (point, link, index) = match label {
            Label::Pole => return ("o".to_owned(), String::new()),
            Label::Image { point, link } => (point, link, None),
            Label::Foot { point, link, index } => (point, link, Some(index.to_string())),
            Label::Trial { point, second } => (point, None, Some(if second { "II" } else { "I" }.to_owned())),
        };
        // A pin has one number, in its velocity and in its image.
        let of_pin = |l: &LinkId| self.mechanism().point(point).links.contains(l);
        let link = link.map(|l| self.home(point).filter(|_| of_pin(&l)).unwrap_or(l));
        let (letters, own) = split(self.point_name(point));
        let indices: Vec<String> =
            [(!own.is_empty()).then(|| own.to_owned()), link.map(|l| self.number_under(point, l)), index]
                .into_iter()
                .flatten()
                .collect();
        (letters.to_lowercase(), indices.join(","))
    }

    /// Two images as the name of a vector's line: ab, o′a′.
    #[must_use]
    pub fn image_line(&self, from: Label, to: Label, kind: DiagramKind) -> Rich {
        self.image(from, kind).then(&self.image(to, kind))
    }

    /// The method by which a quantity is asked, where it is not the usual one.
    #[must_use]
    pub const fn method(&self, method: Method) -> Option<&'static str> {
        match method {
            Method::Polygon => None,
            Method::Centres => Some(self.words.method_centres),
            Method::LineOfCentres => Some(self.words.method_line_of_centres),
            Method::LinkToLink => Some(self.words.method_link_to_link),
            Method::GaugeLine => Some(self.words.method_gauge_line),
            Method::Klein => Some(self.words.method_klein),
            Method::TwoMasses { .. } => Some(self.words.method_two_masses),
            Method::Lever => Some(self.words.method_lever),
            Method::ThreeForce => Some(self.words.method_three_force),
            Method::Components => Some(self.words.method_components),
        }
    }

    /// Letter of angular acceleration.
    #[must_use]
    pub fn alpha(&self) -> &'static str {
        match self.scene.sheet.angular_acceleration {
            Some(AngularAcceleration::Epsilon) => "ε",
            Some(AngularAcceleration::Alpha) => "α",
            None => self.profile.alpha,
        }
    }

    /// The symbol of a quantity; `arrow` sets the letter of a vector with an arrow over it.
    #[must_use]
    pub fn symbol(&self, quantity: Quantity, arrow: bool) -> Rich {
        let letter = |l: &str| if arrow { Rich::vector(l) } else { Rich::italic(l) };
        let book = self.profile;
        let of = |p: PointId| self.home(p).map_or_else(|| self.index(p), |l| self.under(p, l));
        let two = |p, q| match book.relative {
            Relative::Joined => format!("{}{}", self.index(p), self.index(q)),
            Relative::Slash => format!("{}/{}", self.index(p), self.index(q)),
        };
        let numbers = |a, b| {
            let (a, b) = (self.number(a), self.number(b));
            let comma = if a.len() > 1 || b.len() > 1 { "," } else { "" };
            format!("{a}{comma}{b}")
        };
        let n = |sup: &'static str, sub: String| letter(book.acceleration).scripts(sup, Face::Upright, &sub);
        match quantity {
            Quantity::Velocity(p) => letter(book.velocity).sub(&of(p)),
            Quantity::RelativeVelocity(p, q) => letter(book.velocity).sub(&two(p, q)),
            Quantity::Acceleration(p) => letter(book.acceleration).sub(&of(p)),
            Quantity::RelativeAcceleration(p, q) => letter(book.acceleration).sub(&two(p, q)),
            Quantity::RelativeNormal(p, q) => n(book.normal, two(p, q)),
            Quantity::RelativeTangential(p, q) => n(book.tangential, two(p, q)),
            Quantity::Normal(p) => n(book.normal, of(p)),
            Quantity::Tangential(p) => n(book.tangential, of(p)),
            Quantity::Omega(l) => Rich::italic("ω").sub(&self.number(l)),
            Quantity::RelativeOmega(a, b) => Rich::italic("ω").sub(&numbers(a, b)),
            Quantity::Ratio(a, b) => {
                let rate = |l| Rich::italic("ω").sub(&self.number(l));
                rate(a).up("/").then(&rate(b))
            }
            Quantity::Advantage(a, b) => {
                let torque = |l| Rich::italic("T").sub(&self.number(l));
                torque(a).up("/").then(&torque(b))
            }
            Quantity::Alpha(l) => Rich::italic(self.alpha()).sub(&self.number(l)),
            Quantity::RelativeAlpha(a, b) => Rich::italic(self.alpha()).sub(&numbers(a, b)),
            Quantity::Slip(p, l) => letter(book.velocity).sub(&self.coincident(p, l)),
            Quantity::SlipAcceleration(p, l) => letter(book.acceleration).sub(&self.coincident(p, l)),
            // On the frame a pin has no other velocity than along its guide.
            Quantity::SlipNormal(p, LinkId::FRAME) => n(book.normal, of(p)),
            Quantity::SlipTangential(p, LinkId::FRAME) => n(book.tangential, of(p)),
            Quantity::SlipNormal(p, l) => n(book.normal, self.coincident(p, l)),
            Quantity::SlipTangential(p, l) => n(book.tangential, self.coincident(p, l)),
            Quantity::Coriolis(p, l) => n(book.coriolis, self.coincident(p, l)),
            Quantity::CoincidentVelocity(p, l) => letter(book.velocity).sub(&self.under(p, l)),
            Quantity::CoincidentAcceleration(p, l) => letter(book.acceleration).sub(&self.under(p, l)),
            Quantity::CoincidentNormal(p, l) => n(book.normal, self.under(p, l)),
            Quantity::CoincidentTangential(p, l) => n(book.tangential, self.under(p, l)),
            Quantity::TurningVelocity(p, q, l) => letter(book.velocity).sub(&self.both_under(p, q, l)),
            Quantity::TurningNormal(p, q, l) => n(book.normal, self.both_under(p, q, l)),
            Quantity::TurningTangential(p, q, l) => n(book.tangential, self.both_under(p, q, l)),
            Quantity::ContactNormal(p, a, b) => {
                n(book.normal, format!("{}{}", self.under(p, a), self.under(p, b)))
            }
            Quantity::Centre(a, b) => Rich::italic("I").sub(&numbers(a, b)),
            Quantity::Rub(p, i, j) => {
                let pin = format!("{},{}", self.words.rubbing_mark, self.index(p));
                // At a pin of more links than two, of which.
                let links =
                    self.mechanism().moving().filter(|l| self.mechanism().link(*l).points.contains(&p));
                let pair = format!("({}/{})", self.number(i), self.number(j));
                let told = if links.count() > 2 { pin + &pair } else { pin };
                Rich::italic(book.velocity).sub(&told)
            }
            Quantity::PathRadius(p) => Rich::italic("ρ").sub(self.point_name(p)),
            Quantity::Position(p) => self.point(p),
            Quantity::Angle(l) => Rich::italic("θ").sub(&self.number(l)),
            Quantity::Transmission(a, b) => Rich::italic("μ").sub(&numbers(a, b)),
            Quantity::Force(force, share) => super::force_names::symbol(self, force, share),
            Quantity::Cycle(of) => super::cycle::symbol(self, of),
        }
    }

    /// Two points of a link; a pin that is none of its own stands for the point under it.
    fn both_under(&self, p: PointId, q: PointId, link: LinkId) -> String {
        let own = |point: PointId| self.mechanism().link(link).points.contains(&point);
        let [p, q] = [p, q].map(|x| if own(x) { self.index(x) } else { self.under(x, link) });
        match self.profile.relative {
            Relative::Joined => format!("{p}{q}"),
            Relative::Slash => format!("{p}/{q}"),
        }
    }

    /// The symbol of a vector that starts at the image of a point: where the quantity names only the
    /// observed point of a link, its reference is named as well (V of P3 against A).
    #[must_use]
    pub fn symbol_from(&self, quantity: Quantity, reference: Option<PointId>, arrow: bool) -> Rich {
        let reference = reference.filter(|r| !self.mechanism().is_fixed(*r));
        let Some(reference) = reference else { return self.symbol(quantity, arrow) };
        let (letter, sup, point, link) = match quantity {
            Quantity::CoincidentVelocity(p, l) => (self.profile.velocity, "", p, l),
            Quantity::CoincidentAcceleration(p, l) => (self.profile.acceleration, "", p, l),
            Quantity::CoincidentNormal(p, l) => (self.profile.acceleration, self.profile.normal, p, l),
            Quantity::CoincidentTangential(p, l) => {
                (self.profile.acceleration, self.profile.tangential, p, l)
            }
            other => return self.symbol(other, arrow),
        };
        let letter = if arrow { Rich::vector(letter) } else { Rich::italic(letter) };
        let between = if self.profile.relative == Relative::Slash { "/" } else { "" };
        let sub = format!("{}{between}{}", self.under(point, link), self.index(reference));
        letter.scripts(sup, Face::Upright, &sub)
    }

    /// The link by whose number a pin on a moving guide is told from the points under it: 2 of A₂, A₄. Not that of its block,
    /// whose rates nobody reads, unless nothing else has the pin.
    #[must_use]
    pub fn home(&self, point: PointId) -> Option<LinkId> {
        let guides = || self.guides_under(point);
        guides().next()?;
        let links = &self.mechanism().points.get(point.0)?.links;
        let own = links.iter().copied().filter(|l| *l != LinkId::FRAME && guides().all(|g| g != *l));
        own.min_by_key(|l| self.mechanism().link(*l).block)
    }

    /// The moving links on whose guides a pin rides.
    fn guides_under(&self, point: PointId) -> impl Iterator<Item = LinkId> {
        let rides = move |rider| matches!(rider, Rider::Pin { point: p, .. } if p == point);
        let slides = self.mechanism().slides.iter().filter(move |s| rides(s.rider));
        slides.map(|s| s.guide.link).filter(|l| *l != LinkId::FRAME)
    }

    /// A pin on a moving guide with the numbers of all links that have a point there: A₂,A₃,A₄.
    #[must_use]
    pub fn coincident_names(&self, point: PointId) -> Option<Rich> {
        let mut links: Vec<LinkId> = self.guides_under(point).collect();
        if links.is_empty() {
            return None;
        }
        links.extend(self.mechanism().points.get(point.0)?.links.iter().filter(|l| **l != LinkId::FRAME));
        links.sort_by_key(|l| l.0);
        links.dedup();
        let (letters, own) = split(self.point_name(point));
        let name = |l: &LinkId| {
            let comma = if own.is_empty() { "" } else { "," };
            Rich::italic(letters).sub(&format!("{own}{comma}{}", self.number_under(point, *l)))
        };
        let names: Vec<Rich> = links.iter().map(name).collect();
        (names.len() <= 3).then(|| Rich::join(&names, &Rich::upright(",")))
    }

    /// A4: the point of link 4 under pin A.
    fn under(&self, point: PointId, link: LinkId) -> String {
        numbered(&self.index(point), &self.number_under(point, link))
    }

    /// A point's name in the index of a vector.
    #[must_use]
    pub fn index(&self, point: PointId) -> String {
        self.profile.index(self.point_name(point))
    }

    /// A2A4: the pin as a point of its own link, and the point of the guide's link under it.
    fn coincident(&self, point: PointId, guide: LinkId) -> String {
        let name = self.index(point);
        let own = self.mechanism().points.get(point.0);
        let others =
            own.into_iter().flat_map(|p| &p.links).copied().filter(|l| *l != guide && *l != LinkId::FRAME);
        let own = others.min_by_key(|l| self.mechanism().link(*l).block);
        let own = own.map_or_else(String::new, |l| self.number_under(point, l));
        let own = numbered(&name, &own);
        let guide = self.number_under(point, guide);
        if self.profile.apparent {
            format!("{own}/{guide}")
        } else {
            format!("{own}{}", numbered(&name, &guide))
        }
    }

    /// The name of a quantity as a scene writes it: `v(B/A)`.
    #[must_use]
    pub fn quantity_name(&self, quantity: Quantity) -> String {
        quantity.name(self.mechanism())
    }

    /// The scene's unit of velocity or acceleration; of length for positions.
    #[must_use]
    pub fn unit(&self, dimension: Dimension) -> Unit {
        let units = &self.scene.units;
        let (power, times) = match dimension {
            Dimension::Length => return units.length.clone(),
            Dimension::Velocity => ("", units.time.si),
            Dimension::Acceleration => ("^2", units.time.si * units.time.si),
        };
        Unit {
            symbol: format!("{}/{}{power}", units.length.symbol, units.time.symbol),
            si: units.length.si / times,
        }
    }

    /// The unit of ω or of angular acceleration: radians and the scene's time.
    #[must_use]
    pub fn angular_unit(&self, order: Order) -> Unit {
        let time = &self.scene.units.time;
        match order {
            Order::Acceleration => {
                Unit { symbol: format!("rad/{}^2", time.symbol), si: 1.0 / (time.si * time.si) }
            }
            _ => Unit { symbol: format!("rad/{}", time.symbol), si: 1.0 / time.si },
        }
    }

    /// A signed rotation: its size, its unit, its sense after it.
    #[must_use]
    pub fn rotation(&self, si: f64, unit: &Unit) -> Rich {
        self.with_sense(human::quantity(si.abs(), unit), si)
    }

    /// An amount with the sense of this number after it.
    #[must_use]
    pub fn with_sense(&self, amount: Rich, si: f64) -> Rich {
        let sense = self.sense(si);
        if sense.is_empty() { amount } else { amount.word(sense) }
    }

    /// ccw, cw, or nothing for zero.
    #[must_use]
    pub fn sense(&self, value: f64) -> &'static str {
        if value > 0.0 {
            self.words.ccw
        } else if value < 0.0 {
            self.words.cw
        } else {
            ""
        }
    }

    /// The guide of a sliding pair in words.
    #[must_use]
    pub fn guide(&self, slide: usize) -> Rich {
        let name = self.guide_of(slide);
        match self.which_guide(slide) {
            Some(_) if self.lie(slide).is_some() => self.named_guide(slide),
            Some(which) => name.up("\u{a0}(").then(&which).up(")"),
            None => name,
        }
    }

    /// The guide of a sliding pair where its link is told beside it.
    #[must_use]
    pub fn guide_of(&self, slide: usize) -> Rich {
        let Some(own) = self.mechanism().slides.get(slide) else { return Rich::default() };
        match own.rider {
            Rider::Pin { point, .. } => Rich::fill(self.words.guide_of, &[("point", self.point(point))]),
            Rider::Link { link, .. } => {
                Rich::fill(self.words.guide_of_link, &[("link", Rich::upright(self.number(link)))])
            }
        }
    }

    /// How a straight guide of the frame lies, where it is level or upright.
    #[must_use]
    pub fn lie(&self, slide: usize) -> Option<Lie> {
        let own = self.mechanism().slides.get(slide).filter(|own| own.guide.link == LinkId::FRAME)?;
        let Path::Straight { direction: Direction::Angle(angle), turned, .. } = own.guide.path else {
            return None;
        };
        let angle = angle.value + turned.value;
        let is = |wanted: f64| libm::remainder(angle - wanted, std::f64::consts::PI).abs() < 1e-9;
        match (is(0.0), is(std::f64::consts::FRAC_PI_2)) {
            (true, _) => Some(Lie::Level),
            (_, true) => Some(Lie::Upright),
            _ => None,
        }
    }

    /// The guide of a sliding pair in full: the horizontal guide of D. Where one rider has several, this tells a level
    /// from an upright one as well.
    #[must_use]
    pub fn named_guide(&self, slide: usize) -> Rich {
        let (Some(own), Some(lie)) = (self.mechanism().slides.get(slide), self.lie(slide)) else {
            return self.guide(slide);
        };
        let words = self.words;
        match (own.rider, lie) {
            (Rider::Pin { point, .. }, lie) => {
                let template = match lie {
                    Lie::Level => words.level_guide_of,
                    Lie::Upright => words.upright_guide_of,
                };
                Rich::fill(template, &[("point", self.point(point))])
            }
            (Rider::Link { link, .. }, lie) => {
                let template = match lie {
                    Lie::Level => words.level_guide_of_link,
                    Lie::Upright => words.upright_guide_of_link,
                };
                Rich::fill(template, &[("link", Rich::upright(self.number(link)))])
            }
        }
    }

    /// A count in the digits of the language: the number of a page, of a step.
    #[must_use]
    pub fn count(&self, count: usize) -> String {
        self.words.count(count)
    }

    /// What tells the guide from another of the same rider: its link, or its angle on the frame.
    fn which_guide(&self, slide: usize) -> Option<Rich> {
        let slides = &self.mechanism().slides;
        let own = slides.get(slide)?;
        let same = |rider: Rider| match (rider, own.rider) {
            (Rider::Pin { point, .. }, Rider::Pin { point: own, .. }) => point == own,
            (Rider::Link { link, .. }, Rider::Link { link: own, .. }) => link == own,
            _ => false,
        };
        if slides.iter().filter(|other| same(other.rider)).count() < 2 {
            return None;
        }
        match own.guide.path {
            Path::Straight { direction: Direction::Angle(angle), .. } if own.guide.link == LinkId::FRAME => {
                Some(human::degrees(angle.value))
            }
            _ => Some(self.links(&[own.guide.link])),
        }
    }

    /// The line of a moving straight guide by two points on it, where it goes through one of its link.
    pub(super) fn guide_line(&self, slide: usize) -> Option<Rich> {
        let slide = self.mechanism().slides.get(slide)?;
        let Path::Straight { through: GuidePoint::Point(base), offset, .. } = slide.guide.path else {
            return None;
        };
        let rider = match slide.rider {
            Rider::Pin { point, .. } => point,
            Rider::Link { link, .. } => *self.mechanism().links.get(link.0)?.points.first()?,
        };
        let told = slide.guide.link != LinkId::FRAME && offset.value == 0.0 && base != rider;
        told.then(|| self.length(base, rider))
    }

    /// ∥ AB, ⊥ O₄B.
    #[must_use]
    pub fn claim(&self, claim: Claim) -> Rich {
        let (sign, reference) = match claim {
            Claim::Parallel(reference) => ("∥\u{a0}", reference),
            Claim::Perpendicular(reference) => ("⊥\u{a0}", reference),
        };
        let line = match reference {
            Reference::Points(a, b) => self.length(a, b),
            Reference::Guide(slide) => self.guide_line(slide).unwrap_or_else(|| self.guide(slide)),
        };
        match self.is_tangent(claim) {
            true => Rich::fill(self.words.tangent_to, &[("guide", line)]),
            false => Rich::upright(sign).then(&line),
        }
    }

    /// The same in a table of terms, where little room is.
    #[must_use]
    pub fn claim_in_table(&self, claim: Claim) -> Rich {
        match self.is_tangent(claim) {
            true => Rich::upright(self.words.tangent),
            false => self.claim(claim),
        }
    }

    /// Whether what is claimed runs along an arc: nothing is parallel to that.
    fn is_tangent(&self, claim: Claim) -> bool {
        let Claim::Parallel(Reference::Guide(slide)) = claim else { return false };
        let own = self.mechanism().slides.get(slide);
        own.is_some_and(|own| matches!(own.guide.path, Path::Arc { .. }))
    }

    /// A claim as a data attribute: its name, and the line by its points or its guide.
    #[must_use]
    pub fn claim_data(&self, claim: Claim) -> (&'static str, String) {
        let (name, reference) = match claim {
            Claim::Parallel(reference) => ("parallel", reference),
            Claim::Perpendicular(reference) => ("perpendicular", reference),
        };
        let line = match reference {
            Reference::Points(a, b) => format!("{} {}", self.point_name(a), self.point_name(b)),
            Reference::Guide(slide) => format!("guide {}", self.guide_data(slide)),
        };
        (name, line)
    }

    /// A guide as a data attribute, by its rider and the link that carries it: `D/1`, `link 3/4`.
    #[must_use]
    pub fn guide_data(&self, slide: usize) -> String {
        let Some(slide) = self.mechanism().slides.get(slide) else { return String::new() };
        let carrier = self.number(slide.guide.link);
        match slide.rider {
            Rider::Pin { point, .. } => format!("{}/{carrier}", self.point_name(point)),
            Rider::Link { link, .. } => format!("link {}/{carrier}", self.number(link)),
        }
    }

    /// A scale of a polygon: 50 cm/s ≡ 1 cm.
    #[must_use]
    pub fn scale(&self, si_per_mm: f64, dimension: Dimension) -> Rich {
        let unit = self.unit(dimension);
        let value = human::with_unit(&human::stated(si_per_mm * 10.0 / unit.si), &unit.symbol);
        value.up("\u{a0}≡\u{a0}1\u{a0}cm")
    }

    /// The scale of the skeleton: 1 : 10, or 5 : 1 where it is enlarged.
    #[must_use]
    pub fn length_scale(&self, metres_per_mm: f64) -> Rich {
        let ratio = metres_per_mm * 1000.0;
        let colon = "\u{a0}:\u{a0}";
        if ratio >= 1.0 {
            Rich::upright("1").up(colon).then(&human::stated(ratio))
        } else {
            human::stated(1.0 / ratio).up(colon).up("1")
        }
    }
}

/// How a guide lies that is neither oblique nor moving.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Lie {
    /// Horizontal.
    Level,
    /// Vertical.
    Upright,
}

/// The letters of a name and the digits after them.
fn split(name: &str) -> (&str, &str) {
    let letters = name.trim_end_matches(|c: char| c.is_ascii_digit());
    if letters.is_empty() { (name, "") } else { name.split_at(letters.len()) }
}

/// A point's name with a link's number after it; a name that ends with a number has a comma between.
fn numbered(name: &str, number: &str) -> String {
    let comma = if name.ends_with(|last: char| last.is_numeric()) && !number.is_empty() { "," } else { "" };
    format!("{name}{comma}{number}")
}
