//! Links, pairs and inputs of a planar mechanism in SI units, its mobility and its structure.
//!
//! A [`Mechanism`] is what both solvers see. It holds the dimensions *as they were given* (lengths,
//! sides, arms, own coordinates, places): neither solver may take a derived number from here, or one
//! mistake would agree with itself.
//!
//! **Architecture Invariant:** nothing here knows a file format, paper or a solver.

pub mod curve;
pub mod cycle;
pub mod engine;
pub mod force;
pub mod friction;
pub mod group;
mod members;
pub mod quantity;
pub mod report;
pub mod slider_crank;
pub mod spin;
pub mod statement;
pub mod structure;

pub use crate::given::Given;
use force::Forces;
use quantity::Asked;
use statement::Statement;

/// Two coordinates, x to the right and y up, in metres.
pub type GivenPoint = [Given; 2];

/// Index of a link in [`Mechanism::links`]; the frame is [`LinkId::FRAME`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct LinkId(pub usize);

impl LinkId {
    /// The frame, link number 1.
    pub const FRAME: Self = Self(0);
}

/// Index of a named point in [`Mechanism::points`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct PointId(pub usize);

/// Sense of rotation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Sense {
    /// Counter-clockwise, positive.
    Ccw,
    /// Clockwise, negative.
    Cw,
}

/// What is known of a point's place before anything is solved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Place {
    /// A point of the frame, exact.
    Fixed(GivenPoint),
    /// A moving point whose place at this instant is given; the scene room has already brought it
    /// onto its guide and onto given dimensions, so both solvers may rely on it.
    Placed(GivenPoint),
    /// A moving point whose place at this instant a figure states: index into [`Mechanism::statements`].
    Stated(usize),
    /// A rough place: it chooses between assemblies and fixes nothing.
    Near([f64; 2]),
    /// Nothing is known.
    Unknown,
}

impl Place {
    /// The exact place, of a fixed or placed point. A stated one has none before it is drawn or solved for.
    #[must_use]
    pub fn exact(&self) -> Option<GivenPoint> {
        match self {
            Self::Fixed(p) | Self::Placed(p) => Some(*p),
            Self::Stated(_) | Self::Near(_) | Self::Unknown => None,
        }
    }

    /// A hint for choosing the assembly: exact or rough.
    #[must_use]
    pub fn hint(&self) -> Option<[f64; 2]> {
        match self {
            Self::Fixed(p) | Self::Placed(p) => Some([p[0].value, p[1].value]),
            Self::Near(p) => Some(*p),
            Self::Stated(_) | Self::Unknown => None,
        }
    }
}

/// A named point.
#[derive(Debug, Clone, PartialEq)]
pub struct Point {
    /// Its name in the scene (`O2`, `A`).
    pub name: String,
    /// What is known of its place.
    pub place: Place,
    /// The links in which it stands, ascending; the frame is among them for a fixed point. A rider
    /// pin of a numbered block stands in the block as well.
    pub links: Vec<LinkId>,
    /// Journal radius of the pin in metres, for rubbing speeds.
    pub journal: Option<Given>,
}

/// How a link's own geometry is given. Own coordinates follow the scene format: first joint at the
/// origin and x towards the second (`Length`, `Sides`, `Arms`), position 0 at the origin and x along
/// increasing positions (`Line`), stated (`Shape`), or the world's at this instant (`Placed`).
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Two joints this far apart.
    Length(Given),
    /// A straight link: position of each point along it, in the order of [`Link::points`].
    Line(Vec<Given>),
    /// Three joints: sides 1–2, 2–3, 3–1 and the turning sense 1→2→3.
    Sides {
        /// Side 1–2.
        first_second: Given,
        /// Side 2–3.
        second_third: Given,
        /// Side 3–1.
        third_first: Given,
        /// Sense in which 1→2→3 turns.
        turn: Sense,
    },
    /// Three joints: arms 1–2 and 1–3 and the angle from the first arm to the second, ccw.
    Arms {
        /// Arm 1–2.
        second: Given,
        /// Arm 1–3.
        third: Given,
        /// Angle from arm 1–2 to arm 1–3, ccw positive, radians.
        angle: Given,
    },
    /// Own coordinates of each point, in the order of [`Link::points`].
    Shape(Vec<GivenPoint>),
    /// Every point of the link is fixed or placed; its own coordinates are the world's at this
    /// instant. The frame is such a link.
    Placed,
    /// One joint: a block, a wheel, a swivelling guide. The joint is the origin.
    Single,
}

impl Form {
    /// How many points of the link it gives; none where their places are given instead.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match self {
            Self::Length(_) => Some(2),
            Self::Line(positions) => Some(positions.len()),
            Self::Sides { .. } | Self::Arms { .. } => Some(3),
            Self::Shape(points) => Some(points.len()),
            Self::Placed => None,
            Self::Single => Some(1),
        }
    }
}

/// A rigid link.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Its number in the scene; the frame is 1.
    pub number: u32,
    /// Joints and points of interest, in the order of `joins`; for the frame, the fixed points.
    pub points: Vec<PointId>,
    /// How its geometry is given.
    pub form: Form,
    /// Own coordinates of points that the form does not know: the last of [`Link::points`], such as a mass centre.
    pub extra: Vec<GivenPoint>,
    /// A block: it was named by `block` in a sliding pair and has that pin as its only joint.
    pub block: bool,
}

/// A turning pair between two links at a named point. A pin of k links is k−1 pairs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pin {
    /// Where.
    pub point: PointId,
    /// The two links, the lower index first.
    pub links: [LinkId; 2],
}

/// A point of a guide: a named point of the guide's link, or own coordinates in that link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum GuidePoint {
    /// A named point of the link.
    Point(PointId),
    /// Own coordinates of the link.
    Own(GivenPoint),
}

/// Direction of a straight guide in the own coordinates of its link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Direction {
    /// Angle from the own x-axis, ccw, radians.
    Angle(Given),
    /// From the `through` point towards another named point of the link.
    Toward(PointId),
}

/// The path that a guide prescribes, in the own coordinates of its link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Path {
    /// A straight guide.
    Straight {
        /// A point of the line (before `offset`).
        through: GuidePoint,
        /// Its direction (before `turned`).
        direction: Direction,
        /// Added to the direction, ccw, radians.
        turned: Given,
        /// Parallel shift to the left of the final direction, metres.
        offset: Given,
    },
    /// An arc guide.
    Arc {
        /// Centre of curvature.
        centre: GuidePoint,
        /// Radius, metres, positive.
        radius: Given,
    },
}

/// A guide: the link that carries it, and its path.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Guide {
    /// The link that carries the guide.
    pub link: LinkId,
    /// The path in that link.
    pub path: Path,
}

/// What slides on a guide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rider {
    /// A pin, either in the bare slot (`block: None`, a higher pair) or in a numbered block.
    Pin {
        /// The pin.
        point: PointId,
        /// The block in which it turns.
        block: Option<LinkId>,
    },
    /// A link that slides without turning against the guide.
    Link {
        /// The link; its first joint is on the guide.
        link: LinkId,
        /// Angle from the guide's direction to the link's own x-axis, ccw, radians. A link of
        /// placed points rides as placed: `None`.
        turned: Option<Given>,
    },
}

/// A sliding pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Slide {
    /// What slides.
    pub rider: Rider,
    /// On what.
    pub guide: Guide,
}

/// A rolling pair or gear mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Roll {
    /// Two circles.
    Circles {
        /// The two bodies.
        links: [LinkId; 2],
        /// Their centres: a named point of each.
        centres: [PointId; 2],
        /// Their radii in metres, positive.
        radii: [Given; 2],
        /// The second lies inside the first or the other way round (a ring).
        internal: bool,
    },
    /// A circle on a straight line.
    Line {
        /// The body that carries the line.
        guide: Guide,
        /// The wheel.
        wheel: LinkId,
        /// The wheel's centre.
        centre: PointId,
        /// The wheel's radius in metres.
        radius: Given,
    },
}

impl Roll {
    /// The two bodies that roll on each other.
    #[must_use]
    pub fn bodies(&self) -> [LinkId; 2] {
        match self {
            Self::Circles { links, .. } => *links,
            Self::Line { guide, wheel, .. } => [guide.link, *wheel],
        }
    }
}

/// What drives the mechanism.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Input {
    /// A link's angle: of the line from its first to its second joint from +x, ccw.
    Angle {
        /// The driven link.
        link: LinkId,
        /// Radians; `None` where the link is placed.
        angle: Option<Given>,
        /// rad/s, ccw positive.
        omega: Given,
        /// rad/s², ccw positive.
        alpha: Given,
    },
    /// A link's rotation by the speed of one of its points about the link's first joint.
    Speed {
        /// The driven link.
        link: LinkId,
        /// Radians; `None` where the link is placed.
        angle: Option<Given>,
        /// The point whose speed is given.
        point: PointId,
        /// m/s, positive where the point goes ccw about the first joint.
        speed: Given,
        /// rad/s², ccw positive.
        alpha: Given,
    },
    /// A slide's position along its guide.
    Slide {
        /// Index into [`Mechanism::slides`].
        slide: usize,
        /// Metres along the guide from `through` (after `offset`) to the rider; `None` where placed.
        at: Option<Given>,
        /// m/s.
        velocity: Given,
        /// m/s².
        acceleration: Given,
    },
}

/// A planar mechanism at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Mechanism {
    /// The links; index 0 is the frame, the others ascend by number.
    pub links: Vec<Link>,
    /// All named points, in the order of their first mention.
    pub points: Vec<Point>,
    /// The turning pairs, in the order of their points.
    pub pins: Vec<Pin>,
    /// The sliding pairs.
    pub slides: Vec<Slide>,
    /// The rolling pairs.
    pub rolls: Vec<Roll>,
    /// The contact point of each rolling pair, by index of the pair: a named point of no link, under which
    /// both bodies have one.
    pub contacts: Vec<PointId>,
    /// Places that a figure states, each after those on which it hangs.
    pub statements: Vec<Statement>,
    /// The inputs.
    pub inputs: Vec<Input>,
    /// What acts on the links besides their pairs.
    pub forces: Forces,
    /// What is asked, in order.
    pub asked: Vec<Asked>,
}

impl Link {
    /// The points that its form knows; not mass centres and the like that were stated by own coordinates.
    #[must_use]
    pub fn joints(&self) -> &[PointId] {
        let count = self.form.count().unwrap_or(self.points.len());
        self.points.get(..count).unwrap_or(&self.points)
    }

    /// Own coordinates of a point that the form does not know, by its index in [`Link::points`].
    #[must_use]
    pub fn extra_at(&self, index: usize) -> Option<GivenPoint> {
        self.extra.get(index.checked_sub(self.form.count()?)?).copied()
    }

    /// Own coordinates of a point, by its index in [`Link::points`], as far as the scene states them and nothing has to be
    /// constructed for them.
    fn stated_at(&self, index: usize) -> Option<[f64; 2]> {
        let on_axis = |x: f64| Some([x, 0.0]);
        match (&self.form, index) {
            (Form::Placed, _) => None,
            (Form::Shape(points), _) if index < points.len() => Some(points[index].map(|x| x.value)),
            (Form::Line(places), _) if index < places.len() => on_axis(places[index].value),
            (Form::Length(_) | Form::Sides { .. } | Form::Arms { .. } | Form::Single, 0) => on_axis(0.0),
            (Form::Length(length), 1) => on_axis(length.value),
            (Form::Sides { first_second: side, .. } | Form::Arms { second: side, .. }, 1) => {
                on_axis(side.value)
            }
            _ => self.extra_at(index).map(|at| at.map(|x| x.value)),
        }
    }

    /// Whether the scene states a point at the origin of the link's own coordinates.
    #[must_use]
    pub fn has_at_origin(&self, point: PointId) -> bool {
        let at = |index| self.stated_at(index);
        self.points.iter().position(|own| *own == point).and_then(at) == Some([0.0; 2])
    }

    /// Whether the scene states two points of the link at one place.
    #[must_use]
    pub fn states_as_one(&self, one: PointId, other: PointId) -> bool {
        let at = |point| self.stated_at(self.points.iter().position(|own| *own == point)?);
        at(one).is_some_and(|place| at(other) == Some(place))
    }
}

impl Mechanism {
    /// By link: whether it is the frame, or slides without turning against a link of which that is so.
    #[must_use]
    pub fn translating(&self) -> Vec<bool> {
        let mut translates = vec![false; self.links.len()];
        let mut found = vec![LinkId::FRAME];
        while let Some(link) = found.pop() {
            if std::mem::replace(&mut translates[link.0], true) {
                continue;
            }
            for slide in &self.slides {
                let Rider::Link { link: rider, .. } = slide.rider else { continue };
                let pair = [rider, slide.guide.link];
                if pair.contains(&link) {
                    found.extend(pair.into_iter().filter(|&other| other != link));
                }
            }
        }
        translates
    }

    /// Whether a straight guide leads through a point of its link, as far as the scene states it: in whatever way it states the
    /// line, and the link's points.
    #[must_use]
    pub fn leads_through(&self, guide: &Guide, joint: PointId) -> bool {
        /// Stated numbers have about sixteen digits.
        const ROUNDING: f64 = 1e-14;
        let Path::Straight { through, direction, turned, offset } = guide.path else { return false };
        let unshifted = offset.value == 0.0;
        if unshifted
            && (through == GuidePoint::Point(joint)
                || direction == Direction::Toward(joint) && turned.value == 0.0)
        {
            return true;
        }
        let link = self.link(guide.link);
        let stated = |point: PointId| match link.form {
            Form::Placed => self.point(point).place.exact().map(|at| at.map(|x| x.value)),
            _ => link.stated_at(link.points.iter().position(|own| *own == point)?),
        };
        let from = match through {
            GuidePoint::Own(own) => Some(own.map(|x| x.value)),
            GuidePoint::Point(point) => stated(point),
        };
        let (Some([x, y]), Some(joint)) = (from, stated(joint)) else { return false };
        if unshifted && [x, y] == joint {
            return true;
        }
        let angle = match direction {
            Direction::Angle(angle) => Some(angle.value),
            Direction::Toward(point) => stated(point).map(|at| libm::atan2(at[1] - y, at[0] - x)),
        };
        let Some(angle) = angle else { return false };
        let (sine, cosine) = (libm::sin(angle + turned.value), libm::cos(angle + turned.value));
        // To the left of the line through that point, as the offset counts.
        let left = (joint[1] - y) * cosine - (joint[0] - x) * sine;
        let size = [x, y, joint[0], joint[1], offset.value].iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        (left - offset.value).abs() <= ROUNDING * size
    }

    /// The sliding pair of a block that rides on an arc, with its pin.
    #[must_use]
    pub fn arc_of_block(&self, link: LinkId) -> Option<(usize, PointId)> {
        self.slides.iter().enumerate().find_map(|(slide, pair)| match (pair.rider, pair.guide.path) {
            (Rider::Pin { point, block: Some(block) }, Path::Arc { .. }) if block == link => {
                Some((slide, point))
            }
            _ => None,
        })
    }

    /// The link with this index.
    #[must_use]
    pub fn link(&self, id: LinkId) -> &Link {
        &self.links[id.0]
    }

    /// The point with this index.
    #[must_use]
    pub fn point(&self, id: PointId) -> &Point {
        &self.points[id.0]
    }

    /// The link that carries this number.
    #[must_use]
    pub fn link_numbered(&self, number: u32) -> Option<LinkId> {
        self.links.iter().position(|l| l.number == number).map(LinkId)
    }

    /// The point of this name.
    #[must_use]
    pub fn point_named(&self, name: &str) -> Option<PointId> {
        self.points.iter().position(|p| p.name == name).map(PointId)
    }

    /// The rolling pair whose contact point this is.
    #[must_use]
    pub fn roll_at(&self, contact: PointId) -> Option<usize> {
        self.contacts.iter().position(|&c| c == contact)
    }

    /// Every link but the frame.
    pub fn moving(&self) -> impl Iterator<Item = LinkId> + '_ {
        (1..self.links.len()).map(LinkId)
    }

    /// Whether the point belongs to the frame.
    #[must_use]
    pub fn is_fixed(&self, id: PointId) -> bool {
        matches!(self.point(id).place, Place::Fixed(_))
    }
}
