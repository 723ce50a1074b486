//! The page: skeleton symbols, polygons, equation tables, steps, label placement. Its result is a
//! [`Figure`], ink in millimetres with semantic classes.
//!
//! **Architecture Invariant:** nothing here solves; every length and every number comes from the
//! [`Construction`](crate::graphical::construction::Construction). The offset on the page is added here
//! and nowhere else.

mod answers;
mod auxiliary;
mod bidi;
mod booklet;
mod centres;
mod circle;
mod compose;
mod controlling;
mod coriolis;
mod cycle;
mod cycle_lines;
mod derived;
mod detail;
pub mod diagrams;
mod dimensions;
mod feet;
pub mod figure;
pub mod font;
mod force_detail;
mod force_names;
mod forces;
mod friction;
mod given;
mod governor;
mod grid;
mod growth;
mod human;
mod inertia;
mod ink;
mod known;
mod labels;
mod motions;
pub mod moving;
mod notation;
pub mod overlap;
mod overlay;
mod panels;
mod polygon;
mod pose;
mod positions;
mod printed;
mod profile;
mod reach;
mod remark;
mod results;
mod rich;
pub mod scale;
mod skeleton;
mod slots;
mod speeds;
mod stated;
mod statics;
mod steps;
mod table;
pub mod tradeoff;
mod transfer;
mod wanted;
mod waves;
mod words;

pub use answers::{Part, prompt};
pub use booklet::{answer_form, booklet};
pub use compose::{
    Marked, Wished, figure_names, figures, film, paper, question, question_card, question_of_exam,
    question_strip, single, single_of_question, solution, stack, step_by_step,
};
pub use controlling::controlling_force;
pub use figure::Figure;
pub use overlay::{Fault, HandedIn, Own, OwnForce, OwnPoint, Spot, overlay, strips};
pub use remark::{larger_paper, left_out, outgrown, unconfirmed, unnamed};
pub use wanted::{auxiliary, figure_head};
pub use words::Language;

/// The points of a polygon with their names as the sheet prints them, as plain characters.
#[must_use]
pub fn image_names(
    scene: &crate::scene::Scene,
    construction: &crate::graphical::construction::Construction,
    kind: crate::mechanism::quantity::DiagramKind,
) -> Vec<(String, crate::graphical::construction::Label)> {
    let notation = notation::Notation::new(scene, Language::English.words());
    let printed = feet::told_apart(construction, &notation);
    let [Some(drawn), Some(printed)] = [construction.diagram(kind), printed.diagram(kind)] else {
        return Vec::new();
    };
    let pairs = printed.images.iter().zip(&drawn.images);
    pairs.map(|(name, image)| (notation.image_name(name.label, kind), image.label)).collect()
}

/// The scales at which a sheet draws the forces and the turning-moment diagram of a solution.
#[must_use]
pub fn force_paper(
    scene: &crate::scene::Scene,
    construction: &crate::graphical::construction::Construction,
) -> crate::graphical::Paper {
    let notation = notation::Notation::new(scene, Language::English.words());
    crate::graphical::Paper {
        force: construction.forces.as_ref().and_then(|sheet| forces::of_polygons(sheet, &notation)),
        cycle: construction.cycle.as_ref().and_then(|sheet| cycle::paper(sheet, &notation)),
    }
}

/// The scale of the smallest figure on which lengths are measured, metres per millimetre: the skeleton, or one of instant
/// centres that lie far beside it.
#[must_use]
pub fn smallest_lengths(
    scene: &crate::scene::Scene,
    construction: &crate::graphical::construction::Construction,
) -> f64 {
    let notation = notation::Notation::new(scene, Language::English.words());
    let methods = construction.circle.as_ref().map_or(0, |circle| transfer::by_method(circle).len());
    let of_transfers = (0..methods).map(|index| reach::Reach::of_transfer(index, construction, &notation));
    let all = [reach::Reach::of_centres(construction, &notation)].into_iter().chain(of_transfers).flatten();
    let scales = all.map(|reach| reach.construction.space.metres_per_mm);
    scales.fold(construction.space.metres_per_mm, f64::max)
}

/// A name as a sheet prints it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Symbol {
    /// As plain characters: V_B, ω₃.
    pub plain: String,
    /// As hypertext.
    pub html: String,
}

impl From<rich::Rich> for Symbol {
    fn from(text: rich::Rich) -> Self {
        Self { plain: text.plain(), html: text.html() }
    }
}

/// The symbol of a quantity in a scene's notation.
#[must_use]
pub fn symbol(scene: &crate::scene::Scene, quantity: crate::mechanism::quantity::Quantity) -> Symbol {
    notation::Notation::new(scene, Language::English.words()).symbol(quantity, false).into()
}

/// The letter of a polygon's point as the sheet of this construction prints it: o, b, a₄, b′₁.
#[must_use]
pub fn image_symbol(
    scene: &crate::scene::Scene,
    construction: &crate::graphical::construction::Construction,
    label: crate::graphical::construction::Label,
    kind: crate::mechanism::quantity::DiagramKind,
) -> Symbol {
    let notation = notation::Notation::new(scene, Language::English.words());
    let label = feet::printed(construction, &notation, (kind, label));
    notation.image(label, kind).into()
}

/// The name of a polygon's point as plain characters: o, b, a4, b'1.
#[must_use]
pub fn image_name(
    scene: &crate::scene::Scene,
    label: crate::graphical::construction::Label,
    kind: crate::mechanism::quantity::DiagramKind,
) -> String {
    notation::Notation::new(scene, Language::English.words()).image_name(label, kind)
}

#[cfg(test)]
mod tests;
