//! The panels of a sheet: one list of what a construction has drawn, in the order in which it is shown and lettered.

use kurbo::{Point, Rect, Vec2};

use super::compose::{ARABIC_LEADING, TEXT, clear_of};
use super::cycle::CyclePanel;
use super::figure::Group;
use super::forces::ForcePanel;
use super::growth::Births;
use super::notation::Notation;
use super::reach::Reach;
use super::rich::Rich;
use super::table::Block;
use super::words::Words;
use super::{auxiliary, centres, circle, polygon, positions, skeleton, transfer};
use crate::graphical::auxiliary::AuxiliaryDrawing;
use crate::graphical::construction::{Construction, Diagram, TransferInk};
use crate::mechanism::quantity::{DiagramKind, Dimension};

/// The lines of a legend below a drawing may be as wide as this.
const LEGEND: f64 = 80.0;
/// A caption is broken into lines no narrower, mm.
const SLIMMEST: f64 = 44.0;

/// A drawing of the solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Panel {
    /// The skeleton or a vector diagram.
    Diagram(DiagramKind),
    /// The instant centres on the skeleton.
    Centres,
    /// The circle diagram.
    Circle,
    /// A velocity carried over by instant centres, by index of the method.
    Transfer(usize),
    /// A construction on the skeleton, by index.
    Auxiliary(usize),
    /// A free body, a force polygon.
    Force(ForcePanel),
    /// The turning-moment diagram, the levels of energy.
    Cycle(CyclePanel),
}

impl Panel {
    /// The skeleton.
    pub const SKELETON: Self = Self::Diagram(DiagramKind::Skeleton);

    /// What a construction has drawn, in order.
    #[must_use]
    pub fn all(construction: &Construction) -> Vec<Self> {
        // A turning-moment diagram may have no mechanism.
        let bare = construction.cycle.is_some() && construction.space.places.is_empty();
        let mut all = if bare { Vec::new() } else { vec![Self::SKELETON] };
        // Where nothing moves forces need no diagram of the motion.
        let moves = |diagram: &&Diagram| construction.forces.is_none() || !diagram.rests();
        all.extend(construction.diagrams.iter().filter(moves).map(|diagram| Self::Diagram(diagram.kind)));
        if let Some(circle) = &construction.circle {
            all.extend([Self::Centres, Self::Circle]);
            all.extend((0..transfer::by_method(circle).len()).map(Self::Transfer));
        }
        let drawn =
            construction.auxiliary.iter().enumerate().filter(|(_, drawing)| drawing.refused.is_none());
        // The lever takes up forces that were laid off before.
        let (levers, drawn): (Vec<_>, Vec<_>) = drawn.partition(|(_, drawing)| drawing.is_lever());
        let own = |(index, _): (usize, &AuxiliaryDrawing)| Self::Auxiliary(index);
        all.extend(drawn.into_iter().map(own));
        if let Some(sheet) = &construction.forces {
            let told = ForcePanel::all(sheet).into_iter().filter(|panel| panel.is_told(sheet));
            all.extend(told.map(Self::Force));
        }
        all.extend(levers.into_iter().map(own));
        if let Some(sheet) = &construction.cycle {
            all.extend(CyclePanel::all(sheet).into_iter().map(Self::Cycle));
        }
        all
    }

    /// The diagrams among them.
    #[must_use]
    pub fn diagrams(construction: &Construction) -> Vec<Self> {
        Self::all(construction).into_iter().filter(|panel| matches!(panel, Self::Diagram(_))).collect()
    }

    /// Whether it is drawn at a scale that a scene may state; what stands on a skeleton besides is fitted in.
    #[must_use]
    pub const fn has_scale_of_its_own(self) -> bool {
        matches!(self, Self::Diagram(_) | Self::Centres | Self::Circle)
    }

    /// The panel with its caption and scale; none where the construction has no such drawing.
    #[must_use]
    pub fn block(self, construction: &Construction, notation: &Notation<'_>) -> Option<Block> {
        let caption = self.caption(construction, notation)?;
        let drawing = self.drawing(construction, notation, None)?;
        let mut ink = drawing.bounds().unwrap_or(Rect::ZERO);
        // Diagrams over one axis of angles stand one below the other.
        if let (Self::Cycle(_), Some(sheet)) = (self, &construction.cycle) {
            let all = CyclePanel::all(sheet).into_iter();
            for other in all.filter_map(|panel| panel.draw(sheet, notation).bounds()) {
                (ink.x0, ink.x1) = (ink.x0.min(other.x0), ink.x1.max(other.x1));
            }
        }
        Some(framed(drawing, ink, &caption))
    }

    /// The same among other figures than those of the sheet, after so many of them.
    #[must_use]
    pub fn block_at(
        self,
        place: usize,
        construction: &Construction,
        notation: &Notation<'_>,
    ) -> Option<Block> {
        let caption = self.caption_at(place, construction, notation)?;
        Some(captioned(self.drawing(construction, notation, None)?, &caption))
    }

    /// The same with its caption broken into lines about as wide as the drawing, so that more stands beside it.
    #[must_use]
    pub fn slim_block(self, construction: &Construction, notation: &Notation<'_>) -> Option<Block> {
        let caption = self.caption(construction, notation)?;
        let drawing = self.drawing(construction, notation, None)?;
        let width = drawing.bounds().unwrap_or(Rect::ZERO).width().max(SLIMMEST);
        let lines: Vec<Rich> = caption.iter().flat_map(|text| text.wrap(TEXT, width)).collect();
        Some(captioned(drawing, &lines))
    }

    /// The drawing without its caption; with the lives of its ink where these are told.
    #[must_use]
    pub fn drawing(
        self,
        construction: &Construction,
        notation: &Notation<'_>,
        births: Option<&Births<'_>>,
    ) -> Option<Group> {
        match self {
            Self::SKELETON => Some(match births {
                Some(births) => skeleton::growing(construction, notation, births),
                None => skeleton::draw(construction, notation),
            }),
            Self::Diagram(kind) => {
                let births = births.and_then(|births| births.images(kind));
                Some(polygon::draw(construction.diagram(kind)?, &construction.steps, notation, births))
            }
            Self::Centres => {
                let reach = Reach::of_centres(construction, notation)?;
                Some(centres::draw(reach.construction.circle.as_ref()?, &reach, notation, births))
            }
            Self::Circle => Some(circle::draw(construction.circle.as_ref()?, notation)),
            Self::Transfer(index) => {
                let reach = Reach::of_transfer(index, construction, notation)?;
                let circle = reach.construction.circle.as_ref()?;
                let same = transfer::by_method(circle).into_iter().nth(index)?;
                Some(transfer::draw(&same, circle, &reach, notation))
            }
            Self::Auxiliary(index) => {
                let reach = Reach::of_auxiliary(index, construction, notation)?;
                let drawing = reach.construction.auxiliary.get(index)?;
                Some(auxiliary::draw(drawing, &reach, notation))
            }
            Self::Force(panel) => panel.draw(construction.forces.as_ref()?, construction, notation),
            Self::Cycle(panel) => Some(panel.draw(construction.cycle.as_ref()?, notation)),
        }
    }

    /// What stands below the drawing: its letter, name and scale, and the legend of what is dashed in it.
    #[must_use]
    pub fn caption(self, construction: &Construction, notation: &Notation<'_>) -> Option<Vec<Rich>> {
        let place = Self::all(construction).iter().position(|panel| *panel == self)?;
        self.caption_at(place, construction, notation)
    }

    fn caption_at(
        self,
        place: usize,
        construction: &Construction,
        notation: &Notation<'_>,
    ) -> Option<Vec<Rich>> {
        let words = notation.words;
        let name = |caption: &str| Rich::upright(caption);
        let lengths = |own: &Construction| notation.length_scale(own.space.metres_per_mm);
        let skeleton = || lengths(construction);
        let (caption, scale) = match self {
            Self::SKELETON => (name(words.skeleton), skeleton()),
            Self::Diagram(kind) => {
                let scale = notation.scale(construction.diagram(kind)?.si_per_mm, kind.dimension());
                (name(title(kind, words)), scale)
            }
            Self::Centres => {
                let reach = Reach::of_centres(construction, notation)?;
                (name(words.centres_figure), lengths(&reach.construction))
            }
            Self::Circle => (name(words.circle_diagram), Rich::default()),
            Self::Transfer(index) => {
                let reach = Reach::of_transfer(index, construction, notation)?;
                let same = transfer::by_method(reach.construction.circle.as_ref()?).into_iter().nth(index)?;
                let draws = |ink: &TransferInk| {
                    matches!(
                        ink,
                        TransferInk::Velocity { .. }
                            | TransferInk::Turned { .. }
                            | TransferInk::Difference { .. }
                    )
                };
                let draws = same.iter().flat_map(|transfer| &transfer.ink).any(draws);
                let velocities = notation.scale(same.first()?.si_per_mm, Dimension::Velocity);
                let own = lengths(&reach.construction);
                let scale = if draws { own.aside(words.comma, &velocities) } else { own };
                (transfer::title(&same, notation), scale)
            }
            Self::Auxiliary(index) => {
                let drawing = construction.auxiliary.get(index)?;
                let scale = match construction.diagram(DiagramKind::Velocity) {
                    Some(polygon) if drawing.is_lever() => {
                        notation.scale(polygon.si_per_mm, Dimension::Velocity)
                    }
                    _ => lengths(&Reach::of_auxiliary(index, construction, notation)?.construction),
                };
                (auxiliary::title(&drawing.kind, notation), scale)
            }
            Self::Force(panel) => {
                let sheet = construction.forces.as_ref()?;
                let scale = panel.scale(sheet, notation);
                (panel.title(sheet, notation), scale.unwrap_or_else(skeleton))
            }
            Self::Cycle(panel) => {
                (panel.title(notation), panel.scale(construction.cycle.as_ref()?, notation))
            }
        };
        let letter = letter(place, words);
        // Viewers thicken Arabic letters, which takes some of the blank.
        let blank = if words.right_to_left { "\u{2002}" } else { " " };
        let mut caption = Rich::bold(format!("({letter})")).up(blank).then(&caption);
        if !scale.is_empty() {
            let scale = Rich::fill(words.scale, &[("scale", scale)]);
            caption = caption.up(words.comma.trim_end()).up("\u{2002}").then(&scale);
        }
        let mut caption = vec![caption];
        if self == Self::SKELETON {
            caption.extend(positions::legend(construction, notation));
        }
        Some(caption)
    }
}

/// The letter of a panel: after the last one they are doubled, aa, ab.
fn letter(place: usize, words: &Words) -> String {
    let count = words.panels.len();
    let own = words.panels[place % count];
    if place < count { own.to_owned() } else { format!("{}{own}", words.panels[(place / count - 1) % count]) }
}

/// The panel of a construction on the skeleton.
#[must_use]
pub fn of_auxiliary(drawing: &AuxiliaryDrawing, construction: &Construction) -> Option<Panel> {
    let index = construction.auxiliary.iter().position(|other| other.kind == drawing.kind)?;
    Some(Panel::Auxiliary(index))
}

/// What a diagram is called.
#[must_use]
pub const fn title(kind: DiagramKind, words: &Words) -> &'static str {
    match kind {
        DiagramKind::Skeleton => words.skeleton,
        DiagramKind::Velocity => words.velocity_diagram,
        DiagramKind::Acceleration => words.acceleration_diagram,
    }
}

/// A drawing with its caption below it, upper left corner at the origin: lines that are no wider than the drawing or the
/// first of them.
pub(super) fn captioned(drawing: Group, caption: &[Rich]) -> Block {
    let ink = drawing.bounds().unwrap_or(Rect::ZERO);
    framed(drawing, ink, caption)
}

/// The same for a drawing that is to stand in a frame: one of several pictures of a diagram that stand alike.
pub(super) fn framed(drawing: Group, ink: Rect, caption: &[Rich]) -> Block {
    let mut group = Group::new("panel");
    group.group(drawing);
    let first = caption.first().map_or(0.0, |line| line.width(TEXT));
    let width = ink.width().max(first);
    group.translate(Vec2::new((width - ink.width()) / 2.0 - ink.x0, -ink.y0));
    let mut base = ink.height() + 7.0;
    let mut widest = width;
    let mut above: Vec<Rect> = Vec::new();
    for (i, text) in caption.iter().enumerate() {
        // What is said first stays in one line.
        let lines = if i == 0 { vec![text.clone()] } else { text.wrap(TEXT, width.max(LEGEND)) };
        for (k, line) in lines.iter().enumerate() {
            let line = line.set(TEXT);
            let left = (width - line.width) / 2.0;
            let own = line.boxes_at(Point::new(left, 0.0));
            if i + k > 0 {
                base += ARABIC_LEADING.max(clear_of(&above, &own));
            }
            above = own;
            widest = widest.max(line.width);
            line.put(&mut group, Point::new(left, base), "caption");
        }
    }
    // A legend may be wider than a small drawing.
    if widest > width {
        group.translate(Vec2::new((widest - width) / 2.0, 0.0));
    }
    Block { group, width: widest, height: base + 1.5 }
}
