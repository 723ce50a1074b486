//! The scale factors of a solution, and how large its diagrams are in reality, by which scales are chosen.

use std::collections::BTreeSet;

use crate::mechanism::quantity::{DiagramKind, Dimension};
use crate::mechanism::statement::Locus;
use crate::mechanism::structure::Structure;
use crate::mechanism::{Direction, GuidePoint, Input, LinkId, Mechanism, Path, PointId, Rider, Roll};
use crate::plan::Plan;

use super::construction::{Construction, Label, OtherPosition, Spot, TransferInk};
use super::link_figure;

/// The scale factors of a solution: for each dimension, how much one millimetre of paper stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scales([f64; Dimension::ALL.len()], Paper);

/// The paper of forces and of the turning-moment diagram, SI units per millimetre. A hand slips by as much of them; what
/// an exact drawing says does not depend on them, and where none is stated it has its own.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Paper {
    /// Newtons per millimetre of the force polygons.
    pub force: Option<f64>,
    /// Newton metres and radians per millimetre of the turning-moment diagram.
    pub cycle: Option<[f64; 2]>,
}

impl Scales {
    /// Scales by dimension, SI units per millimetre of paper.
    #[must_use]
    pub fn new(of: impl Fn(Dimension) -> f64) -> Self {
        Self(Dimension::ALL.map(of), Paper::default())
    }

    /// The same for a hand that draws forces on such paper.
    #[must_use]
    pub const fn on(mut self, paper: Paper) -> Self {
        self.1 = paper;
        self
    }

    /// The paper of forces.
    #[must_use]
    pub const fn paper(self) -> Paper {
        self.1
    }

    /// SI units per millimetre of paper.
    #[must_use]
    pub const fn of(self, dimension: Dimension) -> f64 {
        self.0[dimension as usize]
    }

    /// Metres per millimetre of paper.
    #[must_use]
    pub const fn length(self) -> f64 {
        self.of(Dimension::Length)
    }

    /// The same with another scale of one dimension.
    #[must_use]
    pub fn with(mut self, dimension: Dimension, si_per_mm: f64) -> Self {
        self.0[dimension as usize] = si_per_mm;
        self
    }
}

/// How large the diagrams are in reality, to choose scales by.
#[derive(Debug, Clone, Default)]
pub struct Extents {
    /// Width and height of the skeleton, m.
    pub space: [f64; 2],
    /// Width and height of the skeleton with its pitch circles, m.
    pub rims: [f64; 2],
    /// Where the skeleton's lower left corner lies, from its origin, m.
    pub least: [f64; 2],
    /// Width and height of the skeleton with the other positions that it shows, m.
    pub positions: [f64; 2],
    /// The vector diagrams, and arrows on the skeleton that have the scale of one.
    pub diagrams: Vec<DiagramExtent>,
    /// The joints of the skeleton, m, from its origin.
    pub joints: Vec<[f64; 2]>,
    /// What is drawn and told so far, at scales that are no page's: how much text stands beside the diagrams.
    pub drawn: Option<Construction>,
}

/// How large a vector diagram is in reality. Of arrows that stand on the skeleton, where there is no such diagram, only
/// the size is known.
#[derive(Debug, Clone, PartialEq)]
pub struct DiagramExtent {
    /// What it shows.
    pub kind: DiagramKind,
    /// Width and height, SI.
    pub size: [f64; 2],
    /// Its points with the pole, SI, without those of trials.
    pub points: Vec<[f64; 2]>,
    /// Its vectors from tail to head, SI, without those of trials.
    pub vectors: Vec<[[f64; 2]; 2]>,
}

impl Extents {
    /// The extent of a vector diagram.
    #[must_use]
    pub fn diagram(&self, kind: DiagramKind) -> Option<&DiagramExtent> {
        self.diagrams.iter().find(|extent| extent.kind == kind)
    }

    /// Scales at which every diagram is so many millimetres large: for numbers, which depend on no scale.
    #[must_use]
    pub fn filling(&self, mm: f64) -> Scales {
        let per_mm = |[width, height]: [f64; 2]| {
            let scale = width.max(height) / mm;
            if scale.is_normal() { scale } else { 1.0 }
        };
        Scales::new(|dimension| {
            let of = self.diagrams.iter().filter(|extent| extent.kind.dimension() == dimension);
            let sizes = of.map(|extent| extent.size);
            let skeleton = (dimension == Dimension::Length).then_some(self.space);
            sizes.chain(skeleton).map(per_mm).reduce(f64::max).unwrap_or(1.0)
        })
    }

    /// The same where the skeleton shows these positions as well.
    #[must_use]
    pub fn with(mut self, others: &[OtherPosition]) -> Self {
        let all = || others.iter().flat_map(|other| other.places.iter().flatten());
        for axis in 0..2 {
            let least = all().map(|at| at[axis]).fold(self.least[axis], f64::min);
            let most = all().map(|at| at[axis]).fold(self.least[axis] + self.space[axis], f64::max);
            self.positions[axis] = most - least;
        }
        self
    }
}

/// Scales at which paper numbers are of order 100, whatever the units.
pub(super) fn provisional_scales(mechanism: &Mechanism) -> Scales {
    scales_for(mechanism, size_of(mechanism, &|_| true, &|_| true))
}

/// The same for what a plan builds: a place or a part beyond all proportion that it leaves out has no part in what is
/// near and far.
pub(super) fn planned_scales(mechanism: &Mechanism, structure: &Structure, plan: &Plan) -> Scales {
    let steps = || plan.diagrams.iter().flat_map(|diagram| &diagram.steps);
    let groups: BTreeSet<usize> = steps().map(|step| step.group).collect();
    let wanted: BTreeSet<PointId> = steps().flat_map(|step| &step.points).map(|(_, point)| *point).collect();
    let built = |link: LinkId| structure.group_of(link).is_some_and(|group| groups.contains(&group));
    let mut on_guides: BTreeSet<PointId> = BTreeSet::new();
    for slide in &mechanism.slides {
        if let Rider::Pin { point, .. } = slide.rider {
            on_guides.insert(point);
        }
        match slide.guide.path {
            Path::Straight { through, direction, .. } => {
                on_guides.extend(if let GuidePoint::Point(point) = through { Some(point) } else { None });
                on_guides.extend(if let Direction::Toward(point) = direction { Some(point) } else { None });
            }
            Path::Arc { .. } => on_guides.extend(&mechanism.link(slide.guide.link).points),
        }
    }
    let counts = |point: PointId| {
        let links = &mechanism.point(point).links;
        wanted.contains(&point)
            || on_guides.contains(&point)
            || (links.len() > 1 && links.iter().any(|link| *link != LinkId::FRAME && built(*link)))
    };
    let (all, near) = (size_of(mechanism, &|_| true, &|_| true), size_of(mechanism, &built, &counts));
    scales_for(mechanism, if near > 0.0 && all > BEYOND * near { near } else { all })
}

/// What is so many times as large as all that is built is beyond all proportion.
const BEYOND: f64 = 1_048_576.0;

/// The largest length in the mechanism, of these links and points.
fn size_of(mechanism: &Mechanism, built: &dyn Fn(LinkId) -> bool, counts: &dyn Fn(PointId) -> bool) -> f64 {
    let mut size: f64 = 0.0;
    let mut longest: f64 = 0.0;
    let mut seen = |x: f64| longest = longest.max(x.abs());
    for (index, link) in mechanism.links.iter().enumerate() {
        if built(LinkId(index)) {
            link_figure::given_lengths(link, counts).into_iter().for_each(&mut seen);
        }
    }
    let points = mechanism.points.iter().enumerate().filter(|(index, _)| counts(PointId(*index)));
    let places: Vec<[f64; 2]> = points.filter_map(|(_, p)| p.place.hint()).collect();
    for locus in mechanism.statements.iter().flat_map(|statement| statement.loci) {
        if let Locus::Circle { radius, .. } = locus {
            seen(radius.value);
        }
    }
    for p in &places {
        size = size.max(libm::hypot(p[0] - places[0][0], p[1] - places[0][1]));
    }
    size.max(longest)
}

fn scales_for(mechanism: &Mechanism, size: f64) -> Scales {
    let (mut speed, mut acceleration) = (0.0_f64, 0.0_f64);
    for input in &mechanism.inputs {
        let (v, a) = match input {
            Input::Angle { omega, alpha, .. } => {
                (omega.value * size, omega.value * omega.value * size + alpha.value.abs() * size)
            }
            Input::Speed { speed, alpha, .. } => {
                (speed.value, speed.value * speed.value / size + alpha.value.abs() * size)
            }
            Input::Slide { velocity, acceleration, .. } => {
                (velocity.value, acceleration.value.abs() + velocity.value * velocity.value / size)
            }
        };
        speed = speed.max(v.abs());
        acceleration = acceleration.max(a.abs());
    }
    let per_mm = |largest: f64| {
        let scale = largest / 100.0;
        if scale.is_normal() { scale } else { 1.0 }
    };
    Scales::new(|dimension| {
        per_mm(match dimension {
            Dimension::Length => size,
            Dimension::Velocity => speed,
            Dimension::Acceleration => acceleration,
        })
    })
}

/// The scales of the board: powers of two at which paper numbers are of order 100. Every operation is homogeneous, so
/// that no bit of an answer depends on them.
pub(super) fn board_scales(mechanism: &Mechanism, structure: &Structure, plan: &Plan) -> Scales {
    let provisional = planned_scales(mechanism, structure, plan);
    Scales::new(|dimension| {
        let (mantissa, exponent) = libm::frexp(provisional.of(dimension));
        libm::ldexp(1.0, if mantissa < std::f64::consts::FRAC_1_SQRT_2 { exponent - 1 } else { exponent })
    })
}

pub(super) fn measure(record: &Construction, mechanism: &Mechanism, scales: Scales) -> Extents {
    let extent = |points: &mut dyn Iterator<Item = [f64; 2]>, start: Option<[f64; 2]>, scale: f64| {
        let mut bounds: Option<[[f64; 2]; 2]> = start.map(|p| [p, p]);
        for p in points {
            let [low, high] = bounds.get_or_insert([p, p]);
            for axis in 0..2 {
                low[axis] = low[axis].min(p[axis]);
                high[axis] = high[axis].max(p[axis]);
            }
        }
        bounds.map_or([0.0; 2], |[low, high]| [(high[0] - low[0]) * scale, (high[1] - low[1]) * scale])
    };
    // What was tried lies anywhere, and where construction lines end has no name.
    let tried = |label: Label| matches!(label, Label::Trial { .. });
    let drawn = record.diagrams.iter().map(|diagram| {
        let scale = scales.of(diagram.kind.dimension());
        let named = || diagram.images.iter().filter(|image| !tried(image.label)).map(|image| image.at);
        let vectors = || diagram.vectors.iter().filter(|v| !tried(v.tail) && !tried(v.head));
        let si = |at: [f64; 2]| at.map(|x| x * scale);
        DiagramExtent {
            kind: diagram.kind,
            size: extent(&mut named().chain(vectors().flat_map(|v| [v.from, v.to])), Some([0.0; 2]), scale),
            points: named().map(si).chain([[0.0; 2]]).collect(),
            vectors: vectors().map(|v| [si(v.from), si(v.to)]).collect(),
        }
    });
    let mut diagrams: Vec<DiagramExtent> = drawn.collect();
    // Arrows on the skeleton, where there is no polygon: half as long as a polygon would be. One at a centre, which may lie
    // anywhere, counts where there is no other.
    let arrows =
        record.circle.iter().flat_map(|c| &c.transfers).flat_map(|t| &t.ink).filter_map(|ink| match ink {
            TransferInk::Velocity { at, tip, .. } | TransferInk::Turned { at, tip, .. } => {
                let at_centre = matches!(ink, TransferInk::Velocity { of: Spot::Centre(_), .. });
                let length = libm::hypot(tip[0] - at[0], tip[1] - at[1]) * scales.of(Dimension::Velocity);
                Some((at_centre, 2.0 * length))
            }
            _ => None,
        });
    let (at_centres, at_points): (Vec<_>, Vec<_>) = arrows.partition(|(at_centre, _)| *at_centre);
    let longest = |all: Vec<(bool, f64)>| all.into_iter().map(|(_, length)| length).reduce(f64::max);
    let longest = longest(at_points).or_else(|| longest(at_centres)).filter(|longest| *longest > 0.0);
    if let Some(longest) = longest
        && record.diagram(DiagramKind::Velocity).is_none()
    {
        let arrows = DiagramExtent {
            kind: DiagramKind::Velocity,
            size: [longest; 2],
            points: Vec::new(),
            vectors: Vec::new(),
        };
        diagrams.insert(0, arrows);
    }
    let far = record.far_centres(mechanism);
    let near = |index: usize| !far.contains(&PointId(index));
    let places = || {
        let all = record.space.places.iter().enumerate();
        all.filter(move |(index, _)| near(*index)).filter_map(|(_, at)| *at)
    };
    let space = extent(&mut places(), None, scales.length());
    let wheels = mechanism.rolls.iter().flat_map(|roll| pitch_circle_corners(roll, record, scales));
    let rims = extent(&mut places().chain(wheels), None, scales.length());
    let least =
        [0, 1].map(|axis| places().map(|at| at[axis] * scales.length()).fold(f64::INFINITY, f64::min));
    let least = least.map(|x| if x.is_finite() { x } else { 0.0 });
    Extents {
        space,
        rims,
        least,
        positions: space,
        diagrams,
        joints: places().map(|at| at.map(|x| x * scales.length())).collect(),
        drawn: Some(record.clone()),
    }
}

/// Opposite corners of the squares about the pitch circles of a roll, on paper.
fn pitch_circle_corners(roll: &Roll, record: &Construction, scales: Scales) -> Vec<[f64; 2]> {
    let circles = match roll {
        Roll::Circles { centres, radii, .. } => [0, 1].map(|i| (centres[i], radii[i].value)).to_vec(),
        Roll::Line { centre, radius, .. } => vec![(*centre, radius.value)],
    };
    let corners = circles.into_iter().filter_map(|(centre, radius)| {
        let [x, y] = (*record.space.places.get(centre.0)?)?;
        let r = radius / scales.length();
        Some([[x - r, y - r], [x + r, y + r]])
    });
    corners.flatten().collect()
}
