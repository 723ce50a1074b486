//! From the board to the page: the board draws at scales that are powers of two, so that no digit depends on them; the
//! page shows the same figures at round ones. Between the two lies a similarity for each diagram.

use crate::mechanism::quantity::{Asked, Dimension, Measure};

use super::Scales;
use super::auxiliary::{AuxiliaryAct, AuxiliaryDrawing, InflectionBy, StrokeShape};
use super::construction::{
    Act, CentrePlace, CircleDiagram, Construction, ConstructionLine, Diagram, Mm2, Space, Transfer,
    TransferAct, TransferInk,
};

/// Whether a vector of this length on paper, as it is read, is too short for an arrow: it is drawn as a point. Shorter than
/// 1.0 mm is what is read so.
#[must_use]
pub fn is_a_point(mm: f64) -> bool {
    /// In tenths of a millimetre.
    const SHORTEST: f64 = 10.0;
    (10.0 * mm).round() < SHORTEST
}

impl Construction {
    /// Brings a construction from the scales of the board to those of the page.
    pub(super) fn bring_to_page(&mut self, asked: &[Asked], board: Scales, page: Scales) {
        // Millimetres of the page for one of the board.
        let by = Scales::new(|dimension| board.of(dimension) / page.of(dimension));
        space(&mut self.space, by.length(), page.length());
        for drawn in &mut self.diagrams {
            let dimension = drawn.kind.dimension();
            diagram(drawn, by.of(dimension), page.of(dimension));
        }
        if let Some(drawn) = &mut self.circle {
            circle(drawn, by, page.of(Dimension::Velocity));
        }
        for drawing in &mut self.auxiliary {
            // The lever is a velocity polygon.
            let dimension = if drawing.is_lever() { Dimension::Velocity } else { Dimension::Length };
            auxiliary(drawing, by.of(dimension));
        }
        for step in &mut self.steps {
            for act in &mut step.acts {
                match act {
                    Act::MeasureLength { mm, .. } => *mm *= by.length(),
                    Act::ByCentres(act) => transfer_act(act, by),
                    Act::LayOffVector { mm, .. }
                    | Act::LayOffFromCentre { mm, .. }
                    | Act::ReadVector { mm, .. } => *mm *= by.of(step.diagram.dimension()),
                    _ => {}
                }
            }
        }
        for (reading, asked) in self.answers.iter_mut().zip(asked) {
            // A normal part follows from velocities, and is drawn among the accelerations.
            let dimension = match asked.quantity.measure() {
                Measure::Acceleration => Dimension::Acceleration,
                _ => asked.quantity.order().dimension(),
            };
            reading.drawn_mm = reading.drawn_mm.map(|mm| mm * by.of(dimension));
        }
    }
}

impl Construction {
    /// The same on a page of another scale of lengths, metres per millimetre: the skeleton, its centres, what is carried
    /// over by them and what is constructed on it. Arrows of velocities on it, polygons and what the steps read off these are
    /// as they were.
    #[must_use]
    pub fn with_lengths_at(&self, metres_per_mm: f64) -> Self {
        let mut own = self.clone();
        let by = self.space.metres_per_mm / metres_per_mm;
        space(&mut own.space, by, metres_per_mm);
        for drawing in own.auxiliary.iter_mut().filter(|drawing| !drawing.is_lever()) {
            auxiliary(drawing, by);
        }
        if let Some(drawn) = &mut own.circle {
            let by = lengths_only(by);
            centres(drawn, by.length());
            for transfer in &mut drawn.transfers {
                transferred(transfer, by, transfer.si_per_mm);
            }
        }
        own
    }

    /// The same with arrows of velocities on the skeleton at another scale, SI units per millimetre, and nothing else of it.
    #[must_use]
    pub fn with_arrows_at(&self, si_per_mm: f64) -> Self {
        let mut own = self.clone();
        for transfer in own.circle.iter_mut().flat_map(|circle| &mut circle.transfers) {
            let by = transfer.si_per_mm / si_per_mm;
            let arrows = Scales::new(|dimension| if dimension == Dimension::Velocity { by } else { 1.0 });
            transferred(transfer, arrows, si_per_mm);
        }
        own
    }

    /// Skeleton and polygons so many times as large on paper, and nothing else of it: for a figure that shows them alone.
    pub fn resize(&mut self, times: f64) {
        let per_mm = self.space.metres_per_mm;
        space(&mut self.space, times, per_mm / times);
        for drawn in &mut self.diagrams {
            let per_mm = drawn.si_per_mm;
            diagram(drawn, times, per_mm / times);
        }
    }
}

impl TransferAct {
    /// The same on a page whose lengths are so many times as long.
    #[must_use]
    pub fn with_lengths_by(mut self, by: f64) -> Self {
        transfer_act(&mut self, lengths_only(by));
        self
    }
}

/// Lengths so many times as long, and nothing else.
fn lengths_only(by: f64) -> Scales {
    Scales::new(|dimension| if dimension == Dimension::Length { by } else { 1.0 })
}

fn scale(at: &mut Mm2, by: f64) {
    *at = at.map(|x| x * by);
}

/// Brings the tip of an arrow that stands on the skeleton along: the place by the skeleton's similarity, the arrow by
/// that of velocities.
fn tip(at: Mm2, tip: &mut Mm2, by: Scales) {
    *tip = [0, 1].map(|k| at[k] * by.length() + (tip[k] - at[k]) * by.of(Dimension::Velocity));
}

fn line(line: &mut ConstructionLine, by: f64) {
    match line {
        ConstructionLine::Ray { from, to, .. } => {
            scale(from, by);
            scale(to, by);
        }
        ConstructionLine::Arc { centre, radius, at, .. } => {
            scale(centre, by);
            scale(at, by);
            *radius *= by;
        }
    }
}

fn space(space: &mut Space, by: f64, metres_per_mm: f64) {
    space.metres_per_mm = metres_per_mm;
    space.places.iter_mut().flatten().for_each(|at| scale(at, by));
    space.axes.iter_mut().flatten().for_each(|axes| scale(&mut axes.origin, by));
    space.lines.iter_mut().for_each(|drawn| line(drawn, by));
}

fn diagram(diagram: &mut Diagram, by: f64, si_per_mm: f64) {
    diagram.si_per_mm = si_per_mm;
    diagram.images.iter_mut().for_each(|image| scale(&mut image.at, by));
    for vector in &mut diagram.vectors {
        scale(&mut vector.from, by);
        scale(&mut vector.to, by);
        let length = libm::hypot(vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]);
        vector.as_point = vector.is_zero || is_a_point(length);
    }
    diagram.lines.iter_mut().for_each(|drawn| line(drawn, by));
    for image in &mut diagram.link_images {
        image.corners.iter_mut().for_each(|(_, at)| scale(at, by));
    }
}

fn centres(circle: &mut CircleDiagram, by: f64) {
    for centre in &mut circle.centres {
        if let CentrePlace::At(at) = &mut centre.place {
            scale(at, by);
        }
    }
}

fn circle(circle: &mut CircleDiagram, by: Scales, si_per_mm: f64) {
    centres(circle, by.length());
    for transfer in &mut circle.transfers {
        transferred(transfer, by, si_per_mm);
    }
}

fn transfer_act(act: &mut TransferAct, by: Scales) {
    match act {
        TransferAct::Ratio { mm, .. } => scale(mm, by.length()),
        TransferAct::CommonSpeed { mm, .. }
        | TransferAct::AboutPole { mm, .. }
        | TransferAct::Omega { mm, .. } => *mm *= by.length(),
        TransferAct::Difference { mm, .. }
        | TransferAct::Gauge { mm, .. }
        | TransferAct::Parallel { mm, .. } => *mm *= by.of(Dimension::Velocity),
        // A′B′ is AB and what the velocity adds to it.
        TransferAct::OmegaByParallel { mm: [longer, own], .. } => {
            *longer = *own * by.length() + (*longer - *own) * by.of(Dimension::Velocity);
            *own *= by.length();
        }
        TransferAct::Translation { .. } => {}
    }
}

fn transferred(transfer: &mut Transfer, by: Scales, si_per_mm: f64) {
    transfer.si_per_mm = si_per_mm;
    transfer.acts.iter_mut().for_each(|act| transfer_act(act, by));
    for ink in &mut transfer.ink {
        match ink {
            TransferInk::LineOfCentres { from, to } | TransferInk::Radius { from, to } => {
                scale(from, by.length());
                scale(to, by.length());
            }
            TransferInk::Velocity { at, tip: head, .. } | TransferInk::Turned { at, tip: head, .. } => {
                tip(*at, head, by);
                scale(at, by.length());
            }
            TransferInk::Difference { foot, from, to, .. } => {
                tip(*foot, from, by);
                tip(*foot, to, by);
                scale(foot, by.length());
            }
            TransferInk::Gauge { from, to, foot } => {
                tip(*foot, to, by);
                scale(from, by.length());
                scale(foot, by.length());
            }
            TransferInk::Arc { centre, from, to } => {
                scale(centre, by.length());
                scale(from, by.length());
                scale(to, by.length());
            }
            TransferInk::Upright { from, to } | TransferInk::ToPole { from, to } => {
                tip(*from, to, by);
                scale(from, by.length());
            }
            TransferInk::Parallel { from, to, link } => {
                tip(link[0], from, by);
                tip(link[1], to, by);
                scale(&mut link[0], by.length());
                scale(&mut link[1], by.length());
            }
        }
    }
}

fn auxiliary(drawing: &mut AuxiliaryDrawing, by: f64) {
    for stroke in &mut drawing.strokes {
        match &mut stroke.shape {
            StrokeShape::Line(from, to) => {
                scale(from, by);
                scale(to, by);
            }
            StrokeShape::Circle { centre, radius } => {
                scale(centre, by);
                *radius *= by;
            }
            StrokeShape::Curve { points, .. } => points.iter_mut().for_each(|at| scale(at, by)),
            StrokeShape::RightAngle { corner, one, other } => {
                scale(corner, by);
                scale(one, by);
                scale(other, by);
            }
        }
    }
    drawing.points.iter_mut().for_each(|point| scale(&mut point.at, by));
    for act in &mut drawing.acts {
        match act {
            // Images on the skeleton have its scale.
            AuxiliaryAct::CrankAsImage { velocity, acceleration, .. } => {
                *velocity /= by;
                *acceleration = acceleration.map(|per_mm| per_mm / by);
            }
            AuxiliaryAct::ReadImage { mm, si_per_mm, .. }
            | AuxiliaryAct::MomentOnLever { mm, si_per_mm, .. } => {
                *mm *= by;
                *si_per_mm /= by;
            }
            AuxiliaryAct::TangentialOnCrank { mm, .. }
            | AuxiliaryAct::InflectionCircle { mm, .. }
            | AuxiliaryAct::InflectionPoint { by: InflectionBy::Acceleration { mm, .. }, .. } => *mm *= by,
            AuxiliaryAct::Loci { within, .. } => *within *= by,
            AuxiliaryAct::AcrossGuide { .. }
            | AuxiliaryAct::NormalOnRod { .. }
            | AuxiliaryAct::AlongGuide { .. }
            | AuxiliaryAct::ReadTurned { .. }
            | AuxiliaryAct::Calculate(_)
            | AuxiliaryAct::PoleByNormals { .. }
            | AuxiliaryAct::InflectionPoint { .. }
            | AuxiliaryAct::AccelerationCentre { .. }
            | AuxiliaryAct::TrialCentre { .. }
            | AuxiliaryAct::TrialVelocities { .. }
            | AuxiliaryAct::OneLine { .. }
            | AuxiliaryAct::OtherPosition { .. }
            | AuxiliaryAct::Bisectors { .. }
            | AuxiliaryAct::SecondMass { .. }
            | AuxiliaryAct::MassesAtPins { .. }
            | AuxiliaryAct::ImageOfSecond { .. }
            | AuxiliaryAct::LinesOfMasses { .. }
            | AuxiliaryAct::OneMassRests { .. }
            | AuxiliaryAct::LinesApart { .. }
            | AuxiliaryAct::CorrectingCouple { .. }
            | AuxiliaryAct::LineOfInertia { .. }
            | AuxiliaryAct::TurnedPolygon
            | AuxiliaryAct::NoArmOnLever { .. }
            | AuxiliaryAct::CoupleOnLever { .. }
            | AuxiliaryAct::EffortOfLever { .. }
            | AuxiliaryAct::Rotation { .. } => {}
        }
    }
}
