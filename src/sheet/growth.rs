//! When each piece of ink came onto the paper, and the drawing as it stands between: what the blackboard shows while the
//! lecturer speaks.
//!
//! A diagram is drawn once, as it is finished; its groups know their [`Moment`]. A picture of an earlier time is that
//! drawing without what came later: nothing in it moves from picture to picture.

use super::figure::{Group, Life, Moment, Node};
use crate::graphical::construction::{
    Act, Calculation, Claim, Construction, ConstructionLine, Diagram, Label, Step,
};
use crate::mechanism::quantity::DiagramKind;
use crate::mechanism::{Input, LinkId, Mechanism, PointId, Rider, Roll, Slide};

/// The class of ink that stood there before.
const OLD: &str = "old";

/// When the ink of a construction came onto the paper.
#[derive(Debug, Clone)]
pub struct Births<'a> {
    mechanism: &'a Mechanism,
    /// By [`PointId`].
    points: Vec<Moment>,
    /// The lines of the skeleton, in their order.
    lines: Vec<Moment>,
    /// The guides that were drawn, by index of the sliding pair.
    guides: Vec<(usize, Moment)>,
    /// ω and, where the second is set, angular acceleration of links, as they were calculated.
    rotations: Vec<(LinkId, bool, Moment)>,
    /// The last moment of all.
    last: Moment,
    /// Of the vector diagrams.
    diagrams: Vec<(DiagramKind, Images)>,
}

/// When the ink of a polygon came onto the paper.
#[derive(Debug, Clone, Default)]
pub struct Images {
    /// The pole.
    pub pole: Moment,
    /// The vectors, in their order.
    pub vectors: Vec<Life>,
    /// The construction lines, in their order.
    pub lines: Vec<Moment>,
    labels: Vec<(Label, Moment)>,
}

impl Images {
    /// When the image of this name was found.
    #[must_use]
    pub fn label(&self, label: Label) -> Moment {
        if label == Label::Pole {
            return self.pole;
        }
        self.labels.iter().find(|(own, _)| *own == label).map_or(self.pole, |(_, moment)| *moment)
    }

    /// When an image of this point was found.
    #[must_use]
    pub fn point(&self, point: PointId) -> Moment {
        let own = |label: &Label| matches!(label, Label::Image { point: p, .. } if *p == point);
        self.labels.iter().find(|(label, _)| own(label)).map_or(self.pole, |(_, moment)| *moment)
    }
}

impl<'a> Births<'a> {
    /// Reads them off the acts of the steps.
    #[must_use]
    pub fn of(construction: &Construction, mechanism: &'a Mechanism) -> Self {
        let steps = &construction.steps;
        let points = (0..mechanism.points.len()).map(|i| place(steps, mechanism, PointId(i))).collect();
        let guide = |(moment, act): (Moment, &Act)| match act {
            Act::DrawGuide { slide } => Some((*slide, moment)),
            _ => None,
        };
        let guides = acts(steps).filter_map(guide).collect();
        let space = &construction.space.lines;
        let on_line = |roll: usize| matches!(mechanism.rolls.get(roll), Some(Roll::Line { .. }));
        let lines = in_turn(space, steps, |act| match act {
            Act::DrawCentrePath { roll, .. } if !on_line(*roll) => Some(Kind::Arc),
            Act::StrikeArc { .. } | Act::StrikeArcThere { .. } | Act::DrawSeeing { .. } => Some(Kind::Arc),
            Act::DrawGuide { .. }
            | Act::LayOffShift { .. }
            | Act::DrawCentrePath { .. }
            | Act::DrawStatedRay { .. }
            | Act::DrawSquare { .. }
            | Act::DrawPath { .. } => Some(Kind::Ray(None)),
            _ => None,
        });
        let diagrams = construction.diagrams.iter().map(|diagram| (diagram.kind, images(diagram, steps)));
        let diagrams = diagrams.collect();
        let rotation = |(moment, act): (Moment, &Act)| match act {
            Act::Calculate(Calculation::Omega { link, .. } | Calculation::Speed { link, .. }) => {
                Some((*link, false, moment))
            }
            Act::Calculate(Calculation::Alpha { link, .. }) => Some((*link, true, moment)),
            _ => None,
        };
        let rotations = acts(steps).filter_map(rotation).collect();
        let last = end(steps, steps.len().saturating_sub(1));
        Self { mechanism, points, lines, guides, rotations, last, diagrams }
    }

    /// The last moment of the steps.
    #[must_use]
    pub fn last(&self) -> Moment {
        self.last
    }

    /// When the rotation of a link was known: that of a driven one with the link itself.
    #[must_use]
    pub fn rotation(&self, link: LinkId, second: bool) -> Moment {
        let drives = |input: &Input| match input {
            Input::Angle { link: driven, .. } | Input::Speed { link: driven, .. } => *driven == link,
            Input::Slide { .. } => false,
        };
        if self.mechanism.inputs.iter().any(drives) {
            return self.link(link);
        }
        let own = self.rotations.iter().find(|(of, order, _)| *of == link && *order == second);
        // What no step calculates is known after them.
        own.map_or(Moment { step: self.last.step + 1, act: 0 }, |(.., moment)| *moment)
    }

    /// When a point was found.
    #[must_use]
    pub fn point(&self, point: PointId) -> Moment {
        self.points.get(point.0).copied().unwrap_or_default()
    }

    /// When the last joint of a link was found.
    #[must_use]
    pub fn link(&self, link: LinkId) -> Moment {
        let points = self.mechanism.links.get(link.0).map_or(&[][..], |link| &link.points);
        points.iter().map(|p| self.point(*p)).max().unwrap_or_default()
    }

    /// When a line of the skeleton was drawn.
    #[must_use]
    pub fn line(&self, index: usize) -> Moment {
        self.lines.get(index).copied().unwrap_or_default()
    }

    /// When the rider of a sliding pair was found.
    #[must_use]
    pub fn rider(&self, slide: &Slide) -> Moment {
        match slide.rider {
            Rider::Pin { point, .. } => self.point(point),
            Rider::Link { link, .. } => self.link(link),
        }
    }

    /// When the guide of a sliding pair was drawn.
    #[must_use]
    pub fn guide(&self, index: usize) -> Moment {
        if let Some((_, moment)) = self.guides.iter().find(|(slide, _)| *slide == index) {
            return *moment;
        }
        let Some(slide) = self.mechanism.slides.get(index) else { return Moment::default() };
        self.rider(slide).max(self.link(slide.guide.link))
    }

    /// Those of a vector diagram.
    #[must_use]
    pub fn images(&self, kind: DiagramKind) -> Option<&Images> {
        self.diagrams.iter().find_map(|(of, images)| (*of == kind).then_some(images))
    }
}

fn acts(steps: &[Step]) -> impl Iterator<Item = (Moment, &Act)> {
    steps.iter().enumerate().flat_map(|(step, all)| {
        all.acts.iter().enumerate().map(move |(act, what)| (Moment { step, act }, what))
    })
}

/// The end of a step.
fn end(steps: &[Step], step: usize) -> Moment {
    let last = steps.get(step).map_or(0, |step| step.acts.len().saturating_sub(1));
    Moment { step, act: last }
}

/// When a point has its place: it is given, an act found it, or its link is solved. What no step mentions is there from
/// the beginning.
fn place(steps: &[Step], mechanism: &Mechanism, point: PointId) -> Moment {
    let Some(given) = mechanism.points.get(point.0) else { return Moment::default() };
    if given.place.exact().is_some() {
        return Moment::default();
    }
    let found = |act: &Act| match act {
        Act::LayOffLink { to: found, .. }
        | Act::LayOffPlace { to: found, .. }
        | Act::LayOffAlong { point: found, .. }
        | Act::MarkIntersection { point: found, .. }
        | Act::TransferPoint { point: found, .. }
        | Act::MarkContact { contact: found } => *found == point,
        _ => false,
    };
    let by_act = acts(steps).find(|(_, act)| found(act)).map(|(moment, _)| moment);
    let solved = |step: &Step| {
        step.diagram == DiagramKind::Skeleton && step.links.iter().any(|link| given.links.contains(link))
    };
    if by_act.is_none() && mechanism.is_given(point) {
        return Moment::default();
    }
    let by_link = || steps.iter().position(solved).map(|step| end(steps, step));
    by_act.or_else(by_link).unwrap_or_default()
}

/// What an act leaves on the paper.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Kind {
    Arc,
    /// With the direction that it claims, where that tells it from others.
    Ray(Option<Claim>),
}

/// The moments of construction lines: each that of the first act of its step that draws such a line and has none yet; where
/// there is none, the end of its step.
fn in_turn(lines: &[ConstructionLine], steps: &[Step], drawn: impl Fn(&Act) -> Option<Kind>) -> Vec<Moment> {
    let mut left: Vec<(Moment, Kind)> =
        acts(steps).filter_map(|(moment, act)| drawn(act).map(|kind| (moment, kind))).collect();
    let one = |line: &ConstructionLine| {
        let (own, kind) = match *line {
            ConstructionLine::Ray { claim, step, .. } => (step, Kind::Ray(claim)),
            ConstructionLine::Arc { step, .. } => (step, Kind::Arc),
        };
        let fits = |(moment, other): &(Moment, Kind)| {
            let same = match (kind, other) {
                (Kind::Ray(a), Kind::Ray(Some(b))) => a == Some(*b),
                (Kind::Ray(_), Kind::Ray(None)) | (Kind::Arc, Kind::Arc) => true,
                _ => false,
            };
            moment.step == own && same
        };
        match left.iter().position(fits) {
            Some(at) => left.remove(at).0,
            None => end(steps, own),
        }
    };
    lines.iter().map(one).collect()
}

fn images(diagram: &Diagram, steps: &[Step]) -> Images {
    let mut all = Images::default();
    let own = || acts(steps).filter(|(moment, _)| steps[moment.step].diagram == diagram.kind);
    all.pole = own().next().map(|(moment, _)| moment).unwrap_or_default();
    let mut know = |label: Label, moment: Moment| {
        if label != Label::Pole && !all.labels.iter().any(|(known, _)| *known == label) {
            all.labels.push((label, moment));
        }
    };
    let mut laid: Vec<(usize, Moment)> = Vec::new();
    for (moment, act) in own() {
        match act {
            Act::LayOffVector { vector, .. } | Act::LayOffFromCentre { vector, .. } => {
                laid.push((*vector, moment));
                for label in diagram.vectors.get(*vector).into_iter().flat_map(|v| [v.tail, v.head]) {
                    know(label, moment);
                }
            }
            Act::MarkMeet { label, .. }
            | Act::DivideImage { label, .. }
            | Act::CompleteImage { label, .. }
            | Act::SameImage { label, .. } => know(*label, moment),
            Act::TryPolygon { .. } => {
                let trials = diagram.images.iter().map(|image| image.label);
                trials.filter(|l| matches!(l, Label::Trial { .. })).for_each(|label| know(label, moment));
            }
            _ => {}
        }
    }
    // What no act names has its place when its vector is drawn.
    for vector in &diagram.vectors {
        for label in [vector.tail, vector.head] {
            know(label, end(steps, vector.step));
        }
    }
    let vectors = diagram.vectors.iter().enumerate().map(|(index, vector)| {
        let own = laid.iter().find(|(laid, _)| *laid == index).map(|(_, at)| *at);
        let reads = |act: &Act| matches!(act, Act::ReadVector { vector, .. } if *vector == index);
        let read = acts(steps).find(|(at, act)| steps[at.step].diagram == diagram.kind && reads(act));
        let read = read.map(|(moment, _)| moment);
        let found = all.label(vector.tail).max(all.label(vector.head));
        // Whoever reads a vector in the step that finds its ends draws its arrow then.
        let born = own.or(read.filter(|read| read.step == found.step)).unwrap_or(found);
        Life { born, read }
    });
    all.vectors = vectors.collect();
    all.lines = in_turn(&diagram.lines, steps, |act| match act {
        Act::DrawRay { claim, .. } => Some(Kind::Ray(Some(*claim))),
        _ => None,
    });
    all
}

/// The construction without the other positions, which no step draws.
#[must_use]
pub fn alone(construction: &Construction) -> Construction {
    Construction { others: Vec::new(), ..construction.clone() }
}

/// The drawing as it stands at a moment: without what comes later; what stood there before `since` and was not used after
/// it is the old.
#[must_use]
pub fn at(finished: &Group, since: Option<Moment>, upto: Moment) -> Group {
    let mut own = Group { children: Vec::new(), ..finished.clone() };
    let within = |moment: Moment| since.is_none_or(|since| moment > since) && moment <= upto;
    if let Some(life) = own.life
        && !within(life.born)
        && !life.read.is_some_and(within)
    {
        if !own.class.is_empty() {
            own.class.push(' ');
        }
        own.class.push_str(OLD);
    }
    let stands = |node: &&Node| match node {
        Node::Group(group) => group.life.is_none_or(|life| life.born <= upto),
        Node::Mark(_) | Node::Text(_) => true,
    };
    own.children.extend(finished.children.iter().filter(stands).map(|node| match node {
        Node::Group(group) => Node::Group(at(group, since, upto)),
        leaf => leaf.clone(),
    }));
    // A group that is there for its parts alone goes with them.
    own.children.retain(|node| !matches!(node, Node::Group(group) if group.children.is_empty()));
    own
}

/// The same picture without the rules that were shown when they were new: what they explain is seen by now.
#[must_use]
pub fn without_asides(picture: &Group) -> Group {
    let aside = |group: &Group| {
        let has = |word: &str| group.class.split(' ').any(|own| own == word);
        has(OLD) && has("coriolis-rule")
    };
    let mut own = Group { children: Vec::new(), ..picture.clone() };
    own.children.extend(picture.children.iter().filter_map(|node| match node {
        Node::Group(group) if aside(group) => None,
        Node::Group(group) => Some(Node::Group(without_asides(group))),
        leaf => Some(leaf.clone()),
    }));
    own
}

/// Whether anything in a drawing is new between two moments, or used.
#[must_use]
pub fn changes(finished: &Group, since: Option<Moment>, upto: Moment) -> bool {
    let within = |moment: Moment| since.is_none_or(|since| moment > since) && moment <= upto;
    finished.life.is_some_and(|life| within(life.born) || life.read.is_some_and(within))
        || finished.children.iter().any(|node| matches!(node, Node::Group(g) if changes(g, since, upto)))
}
