//! The numbered steps: vector equations with their tables of terms, acts, readings, calculations.

use std::cell::RefCell;
use std::ops::Range;

use super::given::{StatedLength, dimensions};
use super::human;
use super::known::Known;
use super::notation::Notation;
use super::panels::Panel;
use super::polygon::{seen_from, vector_name};
use super::printed::{Figures, Key, Print, absolute};
use super::rich::Rich;
use super::table::{Align, Flow, Table};
use super::words::counted;
use crate::graphical::construction::{
    Act, Calculation, CircleDiagram, Claim, Construction, Diagram, Equation, Label, Reference, Step, Term,
    TermDirection, Vector, VectorKind,
};
use crate::mechanism::quantity::{Answer, DiagramKind, Dimension, Method, Order, Quantity, Unit};
use crate::mechanism::structure::{Closing, TrialDriver};
use crate::mechanism::{Direction, Form, GuidePoint, Input, Link, LinkId, Path, PointId, Rider, Roll, Slide};
use crate::plan::Auxiliary;

/// Flatter crossings than this are badly readable by hand.
const FLAT: f64 = 3.0;

/// A piece of the text of the steps.
#[derive(Debug, Clone)]
pub enum Item {
    /// The head of a step; stays with what follows.
    Head(Rich),
    /// The table of terms of an equation; stays with what follows.
    Terms(Table),
    /// A sentence.
    Sentence(Rich),
}

/// All steps in order.
#[must_use]
pub fn items(construction: &Construction, notation: &Notation<'_>) -> Vec<Item> {
    items_in_figures(construction, notation).0
}

/// The same with the figures in which numbers are printed there.
#[must_use]
pub fn items_in_figures(construction: &Construction, notation: &Notation<'_>) -> (Vec<Item>, Figures) {
    let (told, figures) = with_true_results(construction, notation);
    (told.into_iter().flat_map(|told| told.items).collect(), figures)
}

/// What is said of a step.
#[derive(Debug, Clone)]
pub struct Told {
    /// Index of the step; of several steps under one head the last.
    pub step: usize,
    /// What is drawn in.
    pub drawn: Option<Panel>,
    /// Head, equations, sentences.
    pub items: Vec<Item>,
    /// Of each item the index of the act on paper that it tells; none of what is said or calculated.
    pub acts: Vec<Option<usize>>,
}

/// The same step by step.
#[must_use]
pub fn by_step(construction: &Construction, notation: &Notation<'_>) -> Vec<Told> {
    with_true_results(construction, notation).0
}

/// What is told, settled; and where a result would stand in the table otherwise than it is, because it was rounded from numbers
/// that had been rounded before, with a figure more as a guard in all from which it follows.
fn with_true_results(construction: &Construction, notation: &Notation<'_>) -> (Vec<Told>, Figures) {
    let tell = |figures: &RefCell<Figures>| tell(construction, notation, figures);
    let (told, figures) = settled(tell);
    let off = |figures: &Figures| -> Vec<Key> {
        let asked = notation.mechanism().asked.iter().zip(&construction.answers);
        let sized = asked.filter_map(|(asked, reading)| {
            let size = match &reading.answer {
                Answer::Scalar { value, .. } => *value,
                Answer::Vector { value: [x, y], .. } => libm::hypot(*x, *y),
                Answer::AtInfinity { .. } | Answer::Indeterminate(_) => return None,
            };
            let polygon = asked.method == Method::Polygon && !reading.zero;
            let key = Key::of(asked.quantity, notation);
            (polygon && figures.is_off(key, size, &asked.unit)).then_some(key)
        });
        sized.collect()
    };
    let before = off(&figures);
    if before.is_empty() {
        return (told, figures);
    }
    let guarded = settled_from(figures.guarding(&before), tell);
    match off(&guarded.1).len() < before.len() {
        true => guarded,
        false => (told, figures),
    }
}

/// What is told, with numbers as they are printed. What is used later in a line that would not close has the figures that this
/// line needs where it is first told: it is told again until every line has what it needs. With the figures in which it is.
pub(super) fn settled<T>(tell: impl Fn(&RefCell<Figures>) -> T) -> (T, Figures) {
    settled_from(Figures::default(), tell)
}

fn settled_from<T>(first: Figures, tell: impl Fn(&RefCell<Figures>) -> T) -> (T, Figures) {
    /// What needs figures for what needs figures, and so on: further back the steps do not look.
    const ROUNDS: usize = 12;
    let mut next = RefCell::new(first);
    let mut told = tell(&next);
    for _ in 0..ROUNDS {
        if next.borrow().suffice() {
            break;
        }
        next = RefCell::new(next.into_inner().again());
        told = tell(&next);
    }
    (told, next.into_inner())
}

/// Whether a step finds velocities from centres.
fn from_centres(step: &Step) -> bool {
    step.acts.iter().any(|act| matches!(act, Act::ByCentres(_) | Act::LayOffFromCentre { .. }))
}

/// How the centres are found, and where they lie; with the act that each line tells.
fn told_centres(
    circle: &CircleDiagram,
    construction: &Construction,
    notation: &Notation<'_>,
) -> Vec<(Item, Option<usize>)> {
    let read = super::derived::centres(construction, notation);
    let read = read.into_iter().map(|read| (Item::Sentence(read), None));
    super::circle::items(circle, notation).into_iter().chain(read).collect()
}

fn tell(construction: &Construction, notation: &Notation<'_>, figures: &RefCell<Figures>) -> Vec<Told> {
    let mut all: Vec<Told> = Vec::new();
    let mut rubbing = false;
    let mut measured: Vec<[PointId; 2]> = Vec::new();
    let (mut marked, mut centred) = (false, false);
    let mut known = Known::given(construction, notation, figures);
    tell_driven_slides(notation, figures);
    let mut conversions = Some(conversions(notation, figures));
    for (i, step) in construction.steps.iter().enumerate() {
        // Where nothing moves forces need no diagram of the motion.
        let rests = construction.diagram(step.diagram).is_some_and(Diagram::rests);
        if construction.forces.is_some() && step.diagram != DiagramKind::Skeleton && rests {
            continue;
        }
        // Where velocities are found from centres these come first.
        if let Some(circle) = construction.circle.as_ref().filter(|_| !centred && from_centres(step)) {
            centred = true;
            let (items, acts) = told_centres(circle, construction, notation).into_iter().unzip();
            all.push(Told { step: i, drawn: Some(Panel::Centres), items, acts });
        }
        let teller = Teller { construction, notation, step, figures };
        // Rubbing speeds of several pins stand under one head.
        let rubs = only_rubs(step);
        let same = rubs && rubbing;
        rubbing = rubs;
        if let Some(told) = all.last_mut().filter(|_| same) {
            let lines = step.acts.iter().filter_map(|act| teller.act(act));
            lines.for_each(|line| told.say(Item::Sentence(line), None));
            told.step = i;
            continue;
        }
        let head = Rich::bold(format!("{}.", notation.count(all.len() + 1 - usize::from(centred))));
        let head = head.up("\u{a0}\u{a0}").then(&teller.head());
        let mut own = Told {
            step: i,
            drawn: (!rubs).then_some(Panel::Diagram(step.diagram)),
            items: vec![Item::Head(head)],
            acts: vec![None],
        };
        let moves = step.diagram != DiagramKind::Skeleton;
        if let Some(lines) = conversions.take_if(|_| moves) {
            lines.into_iter().for_each(|line| own.say(Item::Sentence(line), None));
        }
        for told in in_order(step) {
            let index = match told {
                Part::Equation(index) => {
                    own.say(Item::Terms(teller.terms(&step.equations[index])), None);
                    continue;
                }
                Part::Act(index) => index,
            };
            let act = &step.acts[index];
            // What was measured once is known.
            if matches!(act, Act::MarkPlaces) && std::mem::replace(&mut marked, true) {
                continue;
            }
            if let Act::MeasureLength { from, to, .. } = act {
                let told = figures.borrow().has(Key::length([*from, *to]));
                if is_given(notation, [*from, *to]) || told || measured.contains(&[*from, *to]) {
                    continue;
                }
                measured.push([*from, *to]);
            }
            for line in known.missing_rate(act).into_iter().chain(known.missing(act)) {
                own.say(Item::Sentence(line), None);
            }
            // What is read off the figure of the link itself is no distance of two points that stand already.
            let stands_later = |to: PointId| {
                let mut later = step.acts[index..].iter();
                later.any(|act| matches!(act, Act::MarkIntersection { point, .. } if *point == to))
            };
            if matches!(act, Act::MeasureLength { to, .. } if stands_later(*to)) {
                continue;
            }
            if let Act::ByCentres(part) = act {
                let lines = super::transfer::lines(part, construction, notation, figures);
                lines.into_iter().for_each(|line| own.say(Item::Sentence(line), None));
            }
            if let Some(line) = teller.act(act) {
                own.say(Item::Sentence(line), (!matches!(act, Act::Calculate(_))).then_some(index));
            }
            known.learn(act, step.diagram);
        }
        // What was marked at the beginning needs no step of its own.
        if own.items.len() > 1 {
            all.push(own);
        }
    }
    let (derived, only_units) = super::derived::sentences(construction, notation, figures);
    if !derived.is_empty() {
        let number = all.len() + 1 - usize::from(centred);
        let head = Rich::bold(format!("{}.", notation.count(number))).up("\u{a0}\u{a0}");
        let words = notation.words;
        let head = head.then(&Rich::bold(if only_units { words.step_units } else { words.step_derived }));
        let items = [Item::Head(head)].into_iter().chain(derived.into_iter().map(Item::Sentence));
        let items: Vec<Item> = items.collect();
        let step = construction.steps.len().saturating_sub(1);
        all.push(Told { step, drawn: None, acts: vec![None; items.len()], items });
    }
    let mut number = all.len() - usize::from(centred);
    // Constructions of their own follow the steps.
    let step = construction.steps.len().saturating_sub(1);
    let unnumbered = |items: Vec<Item>| items.into_iter().map(|item| (item, None)).collect();
    let mut more = |drawn: Panel, told: Vec<(Item, Option<usize>)>| {
        let (items, acts) = told.into_iter().unzip();
        all.push(Told { step, drawn: Some(drawn), items, acts });
    };
    if let Some(circle) = &construction.circle {
        if !centred {
            more(Panel::Centres, told_centres(circle, construction, notation));
        }
        for (index, mut items) in
            super::transfer::items(circle, construction, notation, figures).into_iter().enumerate()
        {
            // Where no polygon is drawn, velocities begin here.
            if let Some(lines) = conversions.take() {
                let after_head = items.len().min(1);
                items.splice(after_head..after_head, lines.into_iter().map(Item::Sentence));
            }
            more(Panel::Transfer(index), unnumbered(items));
        }
    }
    let auxiliary =
        construction.auxiliary.iter().enumerate().filter(|(_, drawing)| drawing.refused.is_none());
    // The lever takes up forces that were laid off before.
    let (levers, auxiliary): (Vec<_>, Vec<_>) = auxiliary.partition(|(_, drawing)| drawing.is_lever());
    for (index, drawing) in auxiliary {
        let mut items = super::auxiliary::items(index, construction, notation, figures);
        // Where nothing else tells of velocities, they begin here.
        if let Some(lines) = conversions.take_if(|_| matches!(drawing.kind, Auxiliary::Klein { .. })) {
            let after_head = items.len().min(1);
            items.splice(after_head..after_head, lines.into_iter().map(Item::Sentence));
        }
        more(Panel::Auxiliary(index), unnumbered(items));
    }
    if let Some(sheet) = &construction.forces {
        for (panel, mut items) in super::statics::told(sheet, construction, notation, figures) {
            for item in &mut items {
                if let Item::Head(head) = item {
                    number += 1;
                    let mark = Rich::bold(format!("{}.", notation.count(number)));
                    *head = mark.up("\u{a0}\u{a0}").then(head);
                }
            }
            more(Panel::Force(panel), unnumbered(items));
        }
    }
    for (index, _) in levers {
        let items = super::auxiliary::items(index, construction, notation, figures);
        more(Panel::Auxiliary(index), unnumbered(items));
    }
    if let Some(sheet) = &construction.cycle {
        let drawn = Panel::Cycle(super::cycle::CyclePanel::Energy);
        let mut items = super::cycle::items(sheet, notation, figures);
        if let Some(Item::Head(head)) = items.first_mut() {
            *head = Rich::bold(format!("{}.", notation.count(number + 1))).up("\u{a0}\u{a0}").then(head);
        }
        if items.len() > 1 {
            more(drawn, unnumbered(items));
        }
    }
    all.retain(|told| !told.items.is_empty());
    all
}

/// The stated rates of what is driven along a guide of the frame stand in tables of terms as they are stated.
fn tell_driven_slides(notation: &Notation<'_>, figures: &RefCell<Figures>) {
    let mechanism = notation.mechanism();
    for input in &mechanism.inputs {
        let Input::Slide { slide, velocity, acceleration, .. } = input else { continue };
        let Some(slide) = mechanism.slides.get(*slide).filter(|slide| slide.guide.link == LinkId::FRAME)
        else {
            continue;
        };
        let point = match slide.rider {
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => mechanism.link(link).points.first().copied(),
        };
        let Some(point) = point else { continue };
        let rates = [
            (Quantity::Velocity(point), velocity.value, Dimension::Velocity),
            (Quantity::Acceleration(point), acceleration.value, Dimension::Acceleration),
        ];
        for (quantity, value, dimension) in rates.into_iter().filter(|(_, value, _)| *value != 0.0) {
            figures.borrow_mut().tell(Key::of(quantity, notation), value, &notation.unit(dimension));
        }
    }
}

/// Whether a distance is given: by the figure, or by a link's own coordinates.
fn is_given(notation: &Notation<'_>, ends: [PointId; 2]) -> bool {
    let by_figure = super::given::stated_distances(notation).any(|own| own.is_between(ends));
    by_figure || own_coordinates_tell(notation, ends)
}

/// Whether a distance is that of a point which its link has by own coordinates, on the line from the first joint.
fn own_coordinates_tell(notation: &Notation<'_>, [from, to]: [PointId; 2]) -> bool {
    let mechanism = notation.mechanism();
    mechanism.moving().map(|link| mechanism.link(link)).any(|link| {
        let on_line = |index: usize| link.extra_at(index).is_some_and(|at| at[1].value == 0.0);
        let place = link.points.iter().position(|point| *point == to);
        matches!(link.form, Form::Length(_))
            && link.points.first() == Some(&from)
            && place.is_some_and(on_line)
    })
}

impl Told {
    fn say(&mut self, item: Item, act: Option<usize>) {
        self.items.push(item);
        self.acts.push(act);
    }
}

/// An equation or an act of a step, by its index.
#[derive(Debug, Clone, Copy)]
enum Part {
    Equation(usize),
    Act(usize),
}

/// The order in which a step is told: what an equation takes as known is calculated before its table stands there, and the
/// equation of a further point stands where its drawing begins.
fn in_order(step: &Step) -> Vec<Part> {
    let mut begins: Vec<usize> = step.equations.iter().map(|equation| equation.begins).collect();
    begins.extend([0, step.acts.len()]);
    begins.sort_unstable();
    begins.dedup();
    let mut all: Vec<Part> = Vec::new();
    for pair in begins.windows(2) {
        part_in_order(step, pair[0]..pair[1], &mut all);
    }
    all
}

/// The same of the acts from where some equations begin to where the next ones do.
fn part_in_order(step: &Step, acts: Range<usize>, all: &mut Vec<Part>) {
    let own: Vec<usize> =
        (0..step.equations.len()).filter(|&i| step.equations[i].begins == acts.start).collect();
    let reckons = |act: &Act| matches!(act, Act::Calculate(_) | Act::MeasureLength { .. });
    let seeks = own.iter().any(|&i| step.equations[i].has_unknowns());
    // Before this nothing is calculated from what the step itself finds.
    let finds = |act: &Act| match act {
        Act::MarkMeet { .. } | Act::TryPolygon { .. } => true,
        Act::ReadVector { .. } => !seeks,
        _ => false,
    };
    let found = acts.clone().find(|&index| finds(&step.acts[index])).unwrap_or(acts.end);
    let first = |index: &usize| !own.is_empty() && *index < found && reckons(&step.acts[*index]);
    let (early, late): (Vec<usize>, Vec<usize>) = acts.partition(first);
    let takes = |equation: &Equation, index: usize| {
        let Act::Calculate(calculation) = &step.acts[index] else { return false };
        calculated(calculation).is_some_and(|(known, _)| equation.terms().any(|term| term.quantity == known))
    };
    all.extend(early.into_iter().map(Part::Act));
    let mut waiting: Vec<(usize, Option<usize>)> = Vec::new();
    for i in own {
        let last = late.iter().copied().filter(|index| takes(&step.equations[i], *index)).max();
        match last {
            None => all.push(Part::Equation(i)),
            Some(_) => waiting.push((i, last)),
        }
    }
    for index in late {
        all.push(Part::Act(index));
        let now = waiting.iter().filter(|(_, last)| *last == Some(index));
        all.extend(now.map(|(equation, _)| Part::Equation(*equation)));
    }
}

/// The vector whose magnitude a calculation gives, and against which point of its link.
pub(super) fn calculated(calculation: &Calculation) -> Option<(Quantity, Option<PointId>)> {
    match *calculation {
        Calculation::Speed { quantity, ends, .. }
        | Calculation::Normal { quantity, ends, .. }
        | Calculation::Tangential { quantity, ends, .. } => Some((quantity, Some(ends[0]))),
        Calculation::Coriolis { quantity, .. } | Calculation::SlipNormal { quantity, .. } => {
            Some((quantity, None))
        }
        Calculation::Omega { .. }
        | Calculation::Alpha { .. }
        | Calculation::Translation { .. }
        | Calculation::Rub { .. } => None,
    }
}

/// The sentence of a calculation.
#[must_use]
pub fn calculation(
    calculation: &Calculation,
    construction: &Construction,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
) -> Option<Rich> {
    let diagram = match calculation {
        Calculation::Alpha { .. } => DiagramKind::Acceleration,
        _ => DiagramKind::Velocity,
    };
    let step = Step { diagram, links: Vec::new(), equations: Vec::new(), acts: Vec::new() };
    Teller { construction, notation, step: &step, figures }.calculation(calculation)
}

/// A sentence with a warning after it where lines cross too flat to be read by hand.
#[must_use]
pub fn warned(sentence: Rich, crossing: f64, notation: &Notation<'_>) -> Rich {
    if crossing.to_degrees() >= FLAT {
        return sentence;
    }
    let angle = ("angle", human::degrees(crossing));
    sentence.up(" ").then(&Rich::fill(notation.words.flat_crossing, &[angle]))
}

/// The sentence of a reading: so many mm between two images are so much.
#[must_use]
pub fn read(
    vector: Rich,
    [tail, head]: [Label; 2],
    (mm, is_a_point): (f64, bool),
    value: f64,
    polygon: &Diagram,
    notation: &Notation<'_>,
    (figures, key): (&mut Figures, Key),
) -> Rich {
    let words = notation.words;
    let unit = notation.unit(polygon.kind.dimension());
    if value == 0.0 {
        let [tail, head] =
            [("tail", tail), ("head", head)].map(|(name, label)| (name, notation.image(label, polygon.kind)));
        return Rich::fill(words.vector_is_zero, &[("vector", vector), tail, head]);
    }
    if is_a_point {
        let amount = human::with_unit(&figures.tell(key, value, &unit), &unit.symbol);
        return Rich::fill(words.too_short, &[("vector", vector), ("value", amount)]);
    }
    let factor = polygon.si_per_mm / unit.si;
    let more = figures.more_of_reading(key, polygon.kind, mm);
    let (reading, amount, written) = figures.read_off(key, mm, factor, value / unit.si, more);
    figures.note(key, &amount, (written, value / unit.si), &unit);
    let reading = reading
        .up("\u{a0}×\u{a0}")
        .then(&human::stated(factor))
        .up("\u{a0}=\u{a0}")
        .then(&human::with_unit(&amount, &unit.symbol));
    let image = notation.image_line(tail, head, polygon.kind);
    Rich::fill(words.read_vector, &[("vector", vector), ("image", image), ("reading", reading)])
}

/// Between two points: the way from one to the other.
pub(super) const WAY: &str = "\u{2009}→\u{2009}";

/// O₂A as it lies on the paper and as it is; once where the paper shows it in its own size and unit.
pub(super) fn measured_length(
    length: Rich,
    [mm, value]: [Rich; 2],
    metres_per_mm: f64,
    notation: &Notation<'_>,
) -> Rich {
    let unit = &notation.scene.units.length;
    if unit.symbol == "mm" && (metres_per_mm / unit.si - 1.0).abs() < 1e-9 {
        return Rich::fill(notation.words.measured_arms, &[("list", length.up("\u{a0}= ").then(&value))]);
    }
    Rich::fill(notation.words.measure_length, &[("length", length), ("mm", mm), ("value", value)])
}

/// The driven rates in radians where the scene states them otherwise: 300 rpm are 2π · 300 / 60.
pub(super) fn conversions(notation: &Notation<'_>, figures: &RefCell<Figures>) -> Vec<Rich> {
    let mut all = Vec::new();
    for (i, input) in notation.mechanism().inputs.iter().enumerate() {
        let Input::Angle { link, omega, alpha, .. } = input else { continue };
        let Some(stated) = notation.scene.input_units.get(i) else { continue };
        let rates = [
            (Quantity::Omega(*link), omega.value, &stated.rate, Order::Velocity),
            (Quantity::Alpha(*link), alpha.value, &stated.second, Order::Acceleration),
        ];
        for (quantity, value, stated, order) in rates {
            let Some(stated) = stated.as_ref() else { continue };
            let symbol = notation.symbol(quantity, false);
            all.extend(in_radians(symbol, (value, stated), Key::Of(quantity), notation, figures, order));
        }
    }
    all
}

/// A rate in radians, where it is stated otherwise.
pub(super) fn in_radians(
    symbol: Rich,
    (value, stated): (f64, &Unit),
    key: Key,
    notation: &Notation<'_>,
    figures: &RefCell<Figures>,
    order: Order,
) -> Option<Rich> {
    let unit = notation.angular_unit(order);
    if stated.si == unit.si || value == 0.0 {
        return None;
    }
    let number = human::stated(value.abs() / stated.si);
    let ratio = stated.si / unit.si;
    let is = |other: f64| (ratio / other - 1.0).abs() < 1e-9;
    let line = if is(std::f64::consts::TAU / 60.0) {
        Rich::upright("2π\u{a0}×\u{a0}").then(&number).up("\u{a0}/\u{a0}60")
    } else if is(std::f64::consts::PI / 180.0) {
        Rich::upright("π\u{a0}×\u{a0}").then(&number).up("\u{a0}/\u{a0}180")
    } else {
        number.up("\u{a0}×\u{a0}").then(&human::stated(ratio))
    };
    let told = human::with_unit(&figures.borrow_mut().tell(key, value, &unit), &unit.symbol);
    let told = if matches!(key, Key::Of(_)) { notation.with_sense(told, value) } else { told };
    Some(symbol.up("\u{a0}= ").then(&line).up("\u{a0}= ").then(&told))
}

fn only_rubs(step: &Step) -> bool {
    let rub = |act: &Act| matches!(act, Act::Calculate(Calculation::Rub { .. }));
    !step.acts.is_empty() && step.acts.iter().all(rub)
}

/// A term of an equation with the point against which it is, where its quantity does not say so.
struct Written {
    term: Term,
    from: Option<PointId>,
}

struct Teller<'a> {
    construction: &'a Construction,
    notation: &'a Notation<'a>,
    step: &'a Step,
    figures: &'a RefCell<Figures>,
}

impl Teller<'_> {
    fn head(&self) -> Rich {
        let words = self.notation.words;
        if only_rubs(self.step) {
            return Rich::bold(words.step_rubbing);
        }
        // A step that only moves blocks along is named after the point that it finds.
        let found = self.step.acts.iter().find_map(|act| match act {
            Act::MarkMeet { label: Label::Image { point, .. }, .. } => Some(*point),
            _ => None,
        });
        let point = found.filter(|_| self.step.links.is_empty());
        let template = match (self.step.diagram, self.step.links.is_empty() && point.is_none()) {
            (DiagramKind::Skeleton, true) => words.step_frame,
            (DiagramKind::Skeleton, false) => words.step_place,
            (DiagramKind::Velocity, true) => words.step_velocity_pole,
            (DiagramKind::Velocity, false) => words.step_velocity,
            (DiagramKind::Acceleration, true) => words.step_acceleration_pole,
            (DiagramKind::Acceleration, false) => words.step_acceleration,
        };
        let links = point.map_or_else(|| self.notation.links(&self.step.links), |p| self.notation.point(p));
        Rich::fill(template, &[("links", links)]).bolder()
    }

    /// One column per term, the signs between them in columns of their own.
    fn terms(&self, equation: &Equation) -> Table {
        let words = self.notation.words;
        let unit = self.notation.unit(self.step.diagram.dimension());
        let label = |word: &str| Rich::italic(word);
        let mut table = Table {
            columns: vec![Align::Left],
            head: vec![Rich::default()],
            rows: vec![
                vec![label(words.magnitude).up(words.comma).up(&human::pretty(&unit.symbol))],
                vec![label(words.direction)],
            ],
            size: 3.3,
            gap: 2.2,
            flow: if words.right_to_left { Flow::LabelsRight } else { Flow::Rightward },
        };
        let sides = [equation.whole.as_slice(), &equation.left, &equation.right];
        for (side, terms) in sides.into_iter().filter(|terms| !terms.is_empty()).enumerate() {
            // Coriolis is drawn early and written last.
            let coriolis = |t: &&Written| matches!(t.term.quantity, Quantity::Coriolis(..));
            let terms: Vec<Written> = terms.iter().flat_map(|term| self.written(term)).collect();
            let written = terms.iter().filter(|t| !coriolis(t)).chain(terms.iter().filter(coriolis));
            for (i, written) in written.enumerate() {
                if i > 0 || side > 0 {
                    table.columns.push(Align::Middle);
                    table.head.push(Rich::upright(if i > 0 { "+" } else { "=" }));
                    table.rows.iter_mut().for_each(|row| row.push(Rich::default()));
                }
                let (magnitude, direction) = self.term(written, &unit);
                table.columns.push(Align::Middle);
                table.head.push(self.notation.symbol_from(written.term.quantity, written.from, true));
                for (row, cell) in table.rows.iter_mut().zip([magnitude, direction]) {
                    row.push(cell);
                }
            }
        }
        table
    }

    /// A term as it is written: the vector of a point of a link that moves with the link by those of its base and against
    /// this, where the step calculates them. What a hand lays off are these.
    fn written(&self, term: &Term) -> Vec<Written> {
        // What a link's turning gives to one of its points is told against the point about which it turns: on the line to
        // that, or across it, only such a part is drawn.
        let turned = match term.direction {
            Some(TermDirection::Claim(
                Claim::Parallel(Reference::Points(base, _))
                | Claim::Perpendicular(Reference::Points(base, _)),
            )) => Some(base),
            _ => None,
        };
        let whole = || vec![Written { term: *term, from: turned }];
        let (order, parts) = match term.quantity {
            Quantity::CoincidentVelocity(p, l) => (Order::Velocity, vec![Quantity::CoincidentVelocity(p, l)]),
            Quantity::CoincidentAcceleration(p, l) => (
                Order::Acceleration,
                vec![Quantity::CoincidentNormal(p, l), Quantity::CoincidentTangential(p, l)],
            ),
            _ => return whole(),
        };
        let part = |part: Quantity| {
            self.step.acts.iter().find_map(|act| {
                let Act::Calculate(calculation) = act else { return None };
                let (ends, value, claim) = match *calculation {
                    Calculation::Speed { quantity, ends, value, .. }
                    | Calculation::Tangential { quantity, ends, value, .. }
                        if quantity == part =>
                    {
                        (ends, value, Claim::Perpendicular(Reference::Points(ends[0], ends[1])))
                    }
                    Calculation::Normal { quantity, ends, value, .. } if quantity == part => {
                        (ends, value, Claim::Parallel(Reference::Points(ends[0], ends[1])))
                    }
                    _ => return None,
                };
                let direction = Some(TermDirection::Claim(claim));
                let term = Term { quantity: part, magnitude: Some(value.abs()), direction };
                Some((ends[0], Written { term, from: Some(ends[0]) }))
            })
        };
        let parts: Vec<(PointId, Written)> = parts.into_iter().filter_map(part).collect();
        let Some(base) = parts.first().map(|(base, _)| *base) else { return whole() };
        if self.notation.mechanism().is_fixed(base) {
            let told = self.figures.borrow().has(Key::of(term.quantity, self.notation));
            return if told { whole() } else { parts.into_iter().map(|(_, part)| part).collect() };
        }
        let Some(polygon) = self.polygon() else { return whole() };
        let Some(image) = polygon.image_of(base, self.notation.mechanism()) else { return whole() };
        let quantity = match order {
            Order::Acceleration => Quantity::Acceleration(base),
            _ => Quantity::Velocity(base),
        };
        let magnitude = Some(libm::hypot(image.at[0], image.at[1]) * polygon.si_per_mm);
        let term = Term { quantity, magnitude, direction: Some(TermDirection::Found) };
        let first = Written { term, from: None };
        [first].into_iter().chain(parts.into_iter().map(|(_, part)| part)).collect()
    }

    fn term(&self, Written { term, from }: &Written, unit: &Unit) -> (Rich, Rich) {
        let unknown = || Rich::upright(self.notation.words.unknown);
        let key = Key::from(term.quantity, *from, self.notation);
        let magnitude = match term.magnitude {
            // What was found on paper and not read yet is drawn, not a number.
            Some(value)
                if value != 0.0
                    && term.direction == Some(TermDirection::Found)
                    && !self.figures.borrow().has(key) =>
            {
                Rich::tick()
            }
            Some(value) => Rich::tick().gap(0.15).then(&self.figures.borrow_mut().tell(key, value, unit)),
            None => unknown(),
        };
        let direction = match term.direction {
            Some(TermDirection::Found) => self.by_angle(term.quantity).unwrap_or_else(Rich::tick),
            Some(TermDirection::Claim(claim)) => self.notation.claim_in_table(claim),
            None => unknown(),
        };
        (magnitude, direction)
    }

    /// The direction of what this step calculates and lays off along nothing that has a name: nobody has found it on paper.
    fn by_angle(&self, quantity: Quantity) -> Option<Rich> {
        let mut laid_off = self.step.acts.iter().filter_map(|act| match act {
            Act::LayOffVector { vector, .. } => self.vector(*vector),
            _ => None,
        });
        let own = laid_off.find(|vector| vector.quantity == quantity)?;
        (own.claim.is_none() && !own.is_zero && !own.as_point).then(|| self.angle_of(own))
    }

    fn polygon(&self) -> Option<&Diagram> {
        self.construction.diagram(self.step.diagram)
    }

    fn vector(&self, index: usize) -> Option<&Vector> {
        self.polygon()?.vectors.get(index)
    }

    /// Of two lines that meet in the image of a point in which bodies roll on each other: that image and the one of the other
    /// body, from which one of the lines comes. Nothing slips there: the two images are one, and no line is needed.
    fn touching(&self) -> Option<[Label; 2]> {
        /// Nearer than this two places on the paper are one, mm.
        const ONE: f64 = 1e-6;
        if self.step.diagram != DiagramKind::Velocity {
            return None;
        }
        let at =
            |label: Label| self.polygon()?.images.iter().find(|image| image.label == label).map(|i| i.at);
        let contact = |label: Label| match label {
            Label::Image { point, .. } => {
                Some(point).filter(|p| self.notation.mechanism().contacts.contains(p))
            }
            _ => None,
        };
        let met = self.step.acts.iter().filter_map(|act| match act {
            Act::MarkMeet { label, .. } => Some(*label),
            _ => None,
        });
        let rays = || {
            self.step.acts.iter().filter_map(|act| match act {
                Act::DrawRay { from, .. } => Some(*from),
                _ => None,
            })
        };
        let mut pairs = met.flat_map(|own| rays().map(move |other| [own, other]));
        pairs.find(|[own, other]| {
            let one = contact(*own).is_some() && contact(*own) == contact(*other);
            let apart = at(*own).zip(at(*other)).map(|([ax, ay], [bx, by])| libm::hypot(ax - bx, ay - by));
            one && apart.is_some_and(|apart| apart < ONE)
        })
    }

    /// The symbol of a drawn vector.
    fn name(&self, vector: &Vector) -> Rich {
        match self.polygon() {
            Some(polygon) => vector_name(vector, polygon, self.notation),
            None => self.notation.symbol(vector.quantity, false),
        }
    }

    /// What a drawn vector is called in the list of printed numbers.
    fn key(&self, vector: &Vector) -> Key {
        let reference = self.polygon().and_then(|polygon| seen_from(vector, polygon));
        Key::from(vector.quantity, reference, self.notation)
    }

    /// The point by which the sliding of a pair is named.
    fn rider(&self, slide: usize) -> Option<PointId> {
        match self.notation.mechanism().slides[slide].rider {
            Rider::Pin { point, .. } => Some(point),
            Rider::Link { link, .. } => self.notation.mechanism().link(link).points.first().copied(),
        }
    }

    /// What the rate of a trial driver is called.
    fn trial_symbol(&self, driver: TrialDriver, order: Order) -> Option<Rich> {
        let second = order == Order::Acceleration;
        let quantity = match driver {
            TrialDriver::Turn(link) if second => Quantity::Alpha(link),
            TrialDriver::Turn(link) => Quantity::Omega(link),
            TrialDriver::Slide(slide) => {
                let (pin, guide) = (self.rider(slide)?, self.notation.mechanism().slides[slide].guide.link);
                if second { Quantity::SlipAcceleration(pin, guide) } else { Quantity::Slip(pin, guide) }
            }
        };
        Some(self.notation.symbol(quantity, false))
    }

    fn trial_value(&self, driver: TrialDriver, order: Order, si: f64) -> Rich {
        match driver {
            TrialDriver::Turn(_) => self.notation.rotation(si, &self.notation.angular_unit(order)),
            TrialDriver::Slide(_) => human::quantity(si, &self.notation.unit(order.dimension())),
        }
    }

    /// Whether a diagram has the two trial images of a point.
    fn shows_trials(&self, point: PointId, order: Order) -> bool {
        self.construction.diagram(order.diagram()).is_some_and(|polygon| {
            polygon.images.iter().any(|i| matches!(i.label, Label::Trial { point: of, .. } if of == point))
        })
    }

    /// What is read of two trial polygons for the proportion: how far the image that closes is from the first trial's, and the
    /// second trial's from that, as finely as it takes for the proportion to be the rate as it is printed, in a unit of so many SI
    /// units.
    fn read_of_trials(&self, driver: TrialDriver, order: Order, (printed, unit): (f64, f64)) -> Option<Rich> {
        let n = self.notation;
        let (point, tried) = self.step.acts.iter().find_map(|act| match act {
            Act::TryPolygon {
                driver: own,
                closing: Closing::Rod { near: point, .. } | Closing::Slide { pin: point, .. },
                order: of,
                rates,
            } if (*own, *of) == (driver, order) => Some((*point, *rates)),
            _ => None,
        })?;
        let images = &self.construction.diagram(order.diagram())?.images;
        let at = |wanted: Label| images.iter().find(|image| image.label == wanted).map(|image| image.at);
        let own = self.sought_image(point, order)?;
        let [first, second] = [false, true].map(|second| Label::Trial { point, second });
        let from = at(first)?;
        let way = |end: Label| at(end).map(|to| [to[0] - from[0], to[1] - from[1]]);
        let ways = [way(own)?, way(second)?];
        // The image may lie on the other side of the first trial's.
        let ahead = libm::copysign(1.0, ways[0][0] * ways[1][0] + ways[0][1] * ways[1][1]);
        let by_proportion =
            |[part, whole]: [f64; 2]| (tried[0] + (tried[1] - tried[0]) * ahead * part / whole) / unit;
        let mm = ways.map(|[x, y]| libm::hypot(x, y));
        let read = human::readings_for(mm, printed, by_proportion);
        let told = |end: Label, mm: &Rich| n.image_line(first, end, order.diagram()).up("\u{a0}= ").then(mm);
        let list = n.list(&[told(own, &read[0]), told(second, &read[1])]);
        Some(Rich::fill(n.words.measured_arms, &[("list", list)]))
    }

    /// By how much two trial polygons miss, as finely as it takes for the proportion to be the rate as it is printed, in a unit of
    /// so many SI units.
    fn missed(
        &self,
        (driver, order): (TrialDriver, Order),
        missed: [f64; 2],
        (printed, unit): (f64, f64),
    ) -> Option<Rich> {
        let n = self.notation;
        let (closing, tried) = self.step.acts.iter().find_map(|act| match act {
            Act::TryPolygon { driver: own, closing, order: of, rates } if (*own, *of) == (driver, order) => {
                Some((closing, *rates))
            }
            _ => None,
        })?;
        let ahead = missed.map(|miss| libm::copysign(1.0, miss));
        let by_proportion = |[first, second]: [f64; 2]| {
            let [first, second] = [first * ahead[0], second * ahead[1]];
            (tried[0] + (tried[1] - tried[0]) * first / (first - second)) / unit
        };
        let [first, second] = match closing {
            Closing::Angle { .. } => {
                let rate = n.angular_unit(order);
                missed.map(|miss| human::with_unit(&human::number(miss.abs() / rate.si), &rate.symbol))
            }
            _ => {
                let per_mm = self.construction.diagram(order.diagram())?.si_per_mm;
                human::readings_for(missed.map(|miss| miss.abs() / per_mm), printed, by_proportion)
            }
        };
        let template = n.words.trial_missed[usize::from(ahead[0] * ahead[1] < 0.0)];
        Some(Rich::fill(template, &[("first", first), ("second", second)]))
    }

    /// The image that two trials lead to.
    fn sought_image(&self, point: PointId, order: Order) -> Option<Label> {
        let images = &self.construction.diagram(order.diagram())?.images;
        let mut labels = images.iter().map(|image| image.label);
        labels.find(|label| matches!(label, Label::Image { point: of, link: None } if *of == point))
    }

    /// How a position is found by trial.
    fn try_position(&self, driver: TrialDriver, closing: &Closing) -> Option<Rich> {
        let n = self.notation;
        let words = n.words;
        let link = match driver {
            TrialDriver::Turn(link) => ("link", Rich::upright(n.number(link))),
            TrialDriver::Slide(slide) => {
                let pin = self.rider(slide)?;
                return Some(Rich::fill(words.try_position_slide, &[("pin", n.point(pin))]));
            }
        };
        Some(match closing {
            Closing::Rod { near, far, .. } => Rich::fill(
                words.try_position_rod,
                &[link, ("near", n.point(*near)), ("length", n.length(*far, *near))],
            ),
            // Of a ride the guide may run past the rider.
            Closing::Slide { slide, .. }
                if matches!(n.mechanism().slides[*slide].rider, Rider::Link { .. }) =>
            {
                Rich::fill(words.try_position_turn, &[link])
            }
            Closing::Slide { pin, .. } => {
                Rich::fill(words.try_position_guide, &[link, ("near", n.point(*pin))])
            }
            Closing::Angle { link: driven, .. } => {
                Rich::fill(words.try_position_angle, &[link, ("driven", Rich::upright(n.number(*driven)))])
            }
            Closing::Driven { .. } | Closing::Contact { .. } => Rich::fill(words.try_position_turn, &[link]),
            // Rolling says nothing of the position.
            Closing::Roll { .. } => return None,
        })
    }

    /// The sentence of an act; none where it refers to what is not there.
    fn act(&self, act: &Act) -> Option<Rich> {
        let n = self.notation;
        let words = n.words;
        let diagram = self.step.diagram;
        let length_unit = &n.scene.units.length;
        let per_mm = self.construction.space.metres_per_mm;
        let metres = |ends: [PointId; 2], si: f64| self.length_as_told(ends, si);
        let image = |label| n.image(label, diagram);
        let sentence = match act {
            Act::MarkPlaces => {
                let points: Vec<Rich> = (0..n.mechanism().points.len())
                    .map(PointId)
                    .filter(|p| n.mechanism().point(*p).place.exact().is_some())
                    .map(|p| n.point(p))
                    .collect();
                if points.is_empty() {
                    return None;
                }
                Rich::fill(
                    counted(words.mark_places, points.len()),
                    &[("points", n.list(&points)), ("scale", n.length_scale(per_mm))],
                )
            }
            Act::TryPosition { driver, closing, of_no_dyad } => {
                let told = self.try_position(*driver, closing)?;
                if *of_no_dyad { Rich::upright(words.no_dyad_alone).up(" ").then(&told) } else { told }
            }
            Act::TryPolygon { driver, closing, order, rates } => {
                let [first, second] = rates.map(|rate| self.trial_value(*driver, *order, rate));
                let tried =
                    [("rate", self.trial_symbol(*driver, *order)?), ("first", first), ("second", second)];
                let told = |template, shown| Rich::fill(template, &[&tried[..], &[shown]].concat());
                match closing {
                    Closing::Rod { near: point, .. } | Closing::Slide { pin: point, .. }
                        if self.shows_trials(*point, *order) =>
                    {
                        let image = |second| n.image(Label::Trial { point: *point, second }, order.diagram());
                        let sought = n.image(self.sought_image(*point, *order)?, order.diagram());
                        let claim = match *closing {
                            Closing::Slide { slide, .. } => Claim::Parallel(Reference::Guide(slide)),
                            Closing::Rod { near, far, .. } => {
                                Claim::Perpendicular(Reference::Points(far, near))
                            }
                            _ => return None,
                        };
                        let images = n.list(&[image(false), image(true)]);
                        let shown = [("images", images), ("claim", n.claim(claim)), ("image", sought)];
                        Rich::fill(words.try_polygon, &[&tried[..], &shown[..]].concat())
                    }
                    Closing::Angle { link, .. } => told(
                        words.try_polygon_rate,
                        ("given", self.trial_symbol(TrialDriver::Turn(*link), *order)?),
                    ),
                    Closing::Driven { slide, .. } => told(
                        words.try_polygon_rate,
                        ("given", self.trial_symbol(TrialDriver::Slide(*slide), *order)?),
                    ),
                    Closing::Roll { roll } => {
                        let contact = n.mechanism().contacts[*roll];
                        told(words.try_polygon_roll, ("contact", n.point(contact)))
                    }
                    Closing::Rod { near: point, .. }
                    | Closing::Slide { pin: point, .. }
                    | Closing::Contact { centre: point, .. } => {
                        told(words.try_polygon_miss, ("point", n.point(*point)))
                    }
                }
            }
            Act::TrialRate { driver, order, rate, missed } => {
                let quantity = match (driver, order) {
                    (TrialDriver::Turn(link), Order::Acceleration) => Some(Quantity::Alpha(*link)),
                    (TrialDriver::Turn(link), _) => Some(Quantity::Omega(*link)),
                    (TrialDriver::Slide(_), _) => None,
                };
                let (value, printed) = match quantity.filter(|_| *rate != 0.0) {
                    Some(quantity) => {
                        let unit = n.angular_unit(*order);
                        let (told, number) =
                            self.figures.borrow_mut().number(Key::Of(quantity), *rate, &unit);
                        let printed = (libm::copysign(number, *rate), unit.si);
                        (n.with_sense(human::with_unit(&told, &unit.symbol), *rate), printed)
                    }
                    None => {
                        let unit = match driver {
                            TrialDriver::Turn(_) => n.angular_unit(*order),
                            TrialDriver::Slide(_) => n.unit(order.dimension()),
                        };
                        let printed = (human::limited(*rate / unit.si, 0).1, unit.si);
                        (self.trial_value(*driver, *order, *rate), printed)
                    }
                };
                let symbol = self.trial_symbol(*driver, *order)?;
                let told = Rich::fill(words.trial_rate, &[("rate", symbol), ("value", value)]);
                let missed = || missed.and_then(|missed| self.missed((*driver, *order), missed, printed));
                match self.read_of_trials(*driver, *order, printed).or_else(missed) {
                    Some(read) => read.up(" ").then(&told),
                    None => told,
                }
            }
            Act::RollStraight { wheel, centre } => Rich::fill(
                words.rolls_straight,
                &[("link", Rich::upright(n.number(*wheel))), ("point", n.point(*centre))],
            ),
            Act::LeaveOutNormals { contact, centre } => Rich::fill(
                words.leave_out_normals,
                &[
                    ("point", n.point(*contact)),
                    ("line", n.claim(Claim::Parallel(Reference::Points(*centre, *contact)))),
                ],
            ),
            Act::DrawTouching { link, base, centre, offset, radius } => {
                let unit = &n.scene.units.length;
                let parts = [
                    ("link", Rich::upright(n.number(*link))),
                    ("base", n.point(*base)),
                    ("centre", n.point(*centre)),
                    ("line", n.length(*base, *centre)),
                    ("radius", human::quantity(*radius, unit)),
                    ("offset", human::quantity(*offset, unit)),
                ];
                Rich::fill(if *offset > 0.0 { words.touch_beside } else { words.touch_through }, &parts)
            }
            Act::MarkContact { contact } => Rich::fill(words.mark_contact, &[("point", n.point(*contact))]),
            Act::DrawStatedRay { from, angle, .. } => Rich::fill(
                words.draw_stated_ray,
                &[("from", n.point(*from)), ("angle", super::given::degrees(*angle, n))],
            ),
            Act::DrawSquare { through, to: [from, to] } => {
                Rich::fill(words.draw_square, &[("point", n.point(*through)), ("line", n.length(*from, *to))])
            }
            Act::DrawSeeing { ends: [from, to], angle }
                if (angle.abs() - std::f64::consts::FRAC_PI_2).abs() < 1e-9 =>
            {
                Rich::fill(words.draw_on_diameter, &[("line", n.length(*from, *to))])
            }
            Act::DrawSeeing { ends: [from, to], angle } => Rich::fill(
                words.draw_seeing,
                &[("line", n.length(*from, *to)), ("angle", human::degrees(angle.abs()))],
            ),
            Act::DrawPath { point } => {
                let line = super::given::path_of(*point, n)?;
                Rich::fill(words.draw_path, &[("line", line), ("point", n.point(*point))])
            }
            Act::LayOffLink { from, to, angle, length, .. }
            | Act::LayOffPlace { from, to, angle, length } => Rich::fill(
                words.lay_off_link,
                &[
                    ("from", n.point(*from)),
                    ("to", n.point(*to)),
                    ("length", n.length(*from, *to)),
                    ("value", metres([*from, *to], *length)),
                    ("mm", human::millimetres(length / per_mm)),
                    ("angle", super::given::degrees(self.as_given(*angle), n)),
                ],
            ),
            Act::StrikeArc { centre, to, radius } => self.arc_about([*centre, *to], *radius),
            Act::LayOffShift { base, line: [from, to], angle, length } => Rich::fill(
                words.lay_off_shift,
                &[
                    ("from", n.point(*base)),
                    ("length", n.length(*from, *to)),
                    ("value", metres([*from, *to], *length)),
                    ("mm", human::millimetres(length / per_mm)),
                    ("angle", human::degrees(*angle)),
                ],
            ),
            Act::StrikeArcThere { ends: [centre, pin], point, radius } => Rich::fill(
                words.strike_arc_there,
                &[
                    ("length", n.length(*centre, *pin)),
                    ("value", metres([*centre, *pin], *radius)),
                    ("mm", human::millimetres(radius / per_mm)),
                    ("point", n.point(*point)),
                ],
            ),
            Act::DrawGuide { slide } => match self.slot_about(*slide) {
                Some((pin, centre, radius)) => {
                    self.arc_told([pin, centre], radius, super::given::stated_with_unit(radius, n))
                }
                None => self.arc_to_its_centre(*slide).unwrap_or_else(|| self.draw_track(*slide)),
            },
            Act::LayOffAlong { slide, point, length } => {
                let through = match n.mechanism().slides.get(*slide)?.guide.path {
                    Path::Straight { through, .. } => through,
                    Path::Arc { centre, .. } => centre,
                };
                let parts = [
                    ("value", human::stated_quantity(*length, length_unit)),
                    ("mm", human::millimetres(length / per_mm)),
                    ("place", super::given::place_of(through, n)),
                    ("point", n.point(*point)),
                ];
                Rich::fill(words.lay_off_along, &parts)
            }
            Act::DrawCentrePath { centre, roll } => {
                let stated = |si: f64| human::stated(si / length_unit.si);
                let (template, about, sum, length) = match n.mechanism().rolls.get(*roll)? {
                    Roll::Line { radius, .. } => {
                        let own = human::stated_quantity(radius.value, length_unit);
                        (words.draw_centre_line, Rich::default(), own, radius.value)
                    }
                    Roll::Circles { centres, radii, internal, .. } => {
                        let other = if centres[0] == *centre { centres[1] } else { centres[0] };
                        let [a, b] = radii.map(|radius| radius.value);
                        let (a, b) = (a.max(b), a.min(b));
                        let (sign, length) = if *internal { ("−", a - b) } else { ("+", a + b) };
                        let sum = stated(a).up("\u{a0}").up(sign).up("\u{a0}").then(&stated(b));
                        let sum = sum.up("\u{a0}= ").then(&human::stated_quantity(length, length_unit));
                        (words.draw_centre_arc, n.point(other), sum, length)
                    }
                };
                let mm = human::millimetres(length / per_mm);
                Rich::fill(
                    template,
                    &[("centre", about), ("sum", sum), ("mm", mm), ("point", n.point(*centre))],
                )
            }
            Act::MarkIntersection { point, crossing } => {
                let met = Rich::fill(words.mark_intersection, &[("point", n.point(*point))]);
                warned(met, *crossing, n)
            }
            Act::TransferPoint { link, point } => {
                let drawn = self.step.acts.iter().find_map(|act| match act {
                    Act::DrawGuide { slide } => self.slot_about(*slide).filter(|(_, c, _)| c == point),
                    _ => None,
                });
                let length = dimensions(n.mechanism().link(*link), n)
                    .into_iter()
                    .find(|d| [d.from, d.to].contains(point))
                    .filter(|_| drawn.is_some());
                // What was laid off along its guide stands.
                let laid = |act: &Act| matches!(act, Act::LayOffAlong { point: own, .. } if own == point);
                if self.step.acts.iter().any(laid) {
                    return None;
                }
                if self.is_where_lines_meet(*link, *point) {
                    return Some(Rich::fill(words.mark_intersection, &[("point", n.point(*point))]));
                }
                match length {
                    Some(d) => {
                        let other = if d.from == *point { d.to } else { d.from };
                        let meet = Rich::fill(words.mark_intersection, &[("point", n.point(*point))]);
                        self.arc_about([other, *point], d.length).up(" ").then(&meet)
                    }
                    None => self.transfer_point(*link, *point),
                }
            }
            Act::MeasureLength { from, to, mm, value } => {
                let (mut figures, key) = (self.figures.borrow_mut(), Key::length([*from, *to]));
                let (factor, exact) = (per_mm / length_unit.si, value / length_unit.si);
                let more = figures.more(key);
                let (mm, value, written) = figures.read_off(key, *mm, factor, exact, more);
                figures.note(key, &value, (written, exact), length_unit);
                let value = human::with_unit(&value, &length_unit.symbol);
                measured_length(n.length(*from, *to), [mm, value], per_mm, n)
            }
            // Told in lines of its own.
            Act::ByCentres(_) => return None,
            Act::MarkPole => Rich::fill(words.mark_pole, &[("pole", n.image(Label::Pole, diagram))]),
            Act::Calculate(calculation) => return self.calculation(calculation),
            Act::LayOffVector { vector, mm, .. } => {
                let vector = self.vector(*vector)?;
                // By the number that stands there, where that is its length but for rounding: where a rate was too small to be
                // read, a line has come to nothing, and the vector is there all the same.
                let scale = self.polygon()?.si_per_mm;
                let printed = self.figures.borrow().print_of(self.key(vector)).map(Print::si);
                let told = printed.map(|si| si / scale).filter(|told| (told - mm).abs() <= 0.01 * mm.abs());
                let shown = told.unwrap_or(*mm);
                self.figures.borrow_mut().want_on_paper(self.key(vector), scale);
                let parts = [
                    ("vector", self.name(vector)),
                    ("image", n.image_line(vector.tail, vector.head, diagram)),
                    ("mm", human::millimetres(shown)),
                    ("tail", image(vector.tail)),
                    ("head", image(vector.head)),
                    ("direction", self.direction_of(vector)),
                ];
                let template = match vector {
                    vector if vector.is_zero || *mm == 0.0 => words.vector_is_zero,
                    // No ruler shows less.
                    vector if vector.as_point && *mm < 0.05 => words.vector_too_short,
                    vector if vector.as_point => words.vector_as_point,
                    _ => words.lay_off_vector,
                };
                Rich::fill(template, &parts)
            }
            Act::DrawRay { from, .. } if self.touching().is_some_and(|[_, other]| other == *from) => {
                return None;
            }
            Act::MarkMeet { label, .. } if self.touching().is_some_and(|[own, _]| own == *label) => {
                let [_, with] = self.touching()?;
                let same = Rich::fill(words.same_image, &[("label", image(*label)), ("with", image(with))]);
                Rich::fill(words.no_slip, &[("same", same)])
            }
            Act::DrawRay { from, claim } => {
                Rich::fill(words.draw_ray, &[("from", image(*from)), ("direction", n.claim(*claim))])
            }
            Act::MarkMeet { label, crossing } => {
                let met = Rich::fill(words.mark_meet, &[("label", image(*label))]);
                warned(met, *crossing, n)
            }
            Act::DivideImage { label, from, to, ratio } => {
                // A point on the extension of the line has its image on the extension of the image.
                let beyond = match *ratio {
                    ratio if ratio < 0.0 => Some(*from),
                    ratio if ratio > 1.0 => Some(*to),
                    _ => None,
                };
                let template = if beyond.is_some() { words.produce_image } else { words.divide_image };
                // One goes along it toward the end beyond which the point lies.
                let (first, last) = if beyond == Some(*from) { (*to, *from) } else { (*from, *to) };
                Rich::fill(
                    template,
                    &[
                        ("line", n.image_line(first, last, diagram)),
                        ("image", n.image_line(*from, *to, diagram)),
                        ("beyond", beyond.map(image).unwrap_or_default()),
                        ("part", n.image_line(*from, *label, diagram)),
                        ("ratio", human::number(ratio.abs())),
                        ("label", image(*label)),
                    ],
                )
            }
            Act::CompleteImage { label, link, base }
                if self.ratio_on_line(*link, *label, *base).is_some() =>
            {
                let ratio = self.ratio_on_line(*link, *label, *base)?;
                return self.act(&Act::DivideImage { label: *label, from: base[0], to: base[1], ratio });
            }
            Act::CompleteImage { label, link, base } => Rich::fill(
                words.complete_image,
                &[
                    ("base", n.image_line(base[0], base[1], diagram)),
                    ("link", Rich::upright(n.number(*link))),
                    ("label", image(*label)),
                ],
            ),
            Act::SameImage { label, with } => {
                let same = Rich::fill(words.same_image, &[("label", image(*label)), ("with", image(*with))]);
                // Two bodies have one velocity where they roll on each other.
                let touches = match (*label, *with) {
                    (Label::Image { point, .. }, Label::Image { point: other, .. }) if point != other => {
                        false
                    }
                    (Label::Image { point, .. }, Label::Image { .. } | Label::Pole) => {
                        diagram == DiagramKind::Velocity && n.mechanism().contacts.contains(&point)
                    }
                    _ => false,
                };
                if touches { Rich::fill(words.no_slip, &[("same", same)]) } else { same }
            }
            Act::LayOffFromCentre { vector, link, mm, .. } => {
                let vector = self.vector(*vector)?;
                Rich::fill(
                    words.lay_off_from_centre,
                    &[
                        ("centre", super::circle::name([LinkId::FRAME, *link], n)),
                        ("vector", self.name(vector)),
                        ("image", n.image_line(vector.tail, vector.head, diagram)),
                        ("mm", human::millimetres(*mm)),
                    ],
                )
            }
            Act::ReadVector { vector, mm, value } => {
                let vector = self.vector(*vector)?;
                let ends = [vector.tail, vector.head];
                let key = self.key(vector);
                let mut figures = self.figures.borrow_mut();
                // What was calculated is not read once more.
                if figures.has(key) && !vector.as_point {
                    return None;
                }
                if let Some(line) = self.same_arrow(vector, key, &mut figures) {
                    return Some(line);
                }
                let on_paper = (*mm, vector.as_point);
                read(self.name(vector), ends, on_paper, *value, self.polygon()?, n, (&mut figures, key))
            }
        };
        Some(sentence)
    }

    /// The part of the line between two points of a link at which a third one stands that lies on it.
    fn ratio_on_line(&self, link: LinkId, label: Label, base: [Label; 2]) -> Option<f64> {
        /// By so much of the line's length may a point lie beside it for rounding.
        const BESIDE: f64 = 1e-9;
        let mechanism = self.notation.mechanism();
        let fixed = || mechanism.link(link).points.iter().copied().find(|point| mechanism.is_fixed(*point));
        let place = |label: Label| match label {
            Label::Image { point, .. } => self.at(point),
            Label::Pole => self.at(fixed()?),
            _ => None,
        };
        let (at, from, to) = (place(label)?, place(base[0])?, place(base[1])?);
        let (line, own) = ([to[0] - from[0], to[1] - from[1]], [at[0] - from[0], at[1] - from[1]]);
        let square = line[0] * line[0] + line[1] * line[1];
        let beside = (line[0] * own[1] - line[1] * own[0]).abs();
        (beside <= BESIDE * square).then(|| (line[0] * own[0] + line[1] * own[1]) / square)
    }

    /// What is known already of a vector by another that is the same arrow: where nothing speeds up the acceleration of a
    /// crank pin is its normal part.
    fn same_arrow(&self, vector: &Vector, key: Key, figures: &mut Figures) -> Option<Rich> {
        /// By so much of their length may ends that are one differ for rounding.
        const ONE: f64 = 1e-9;
        let polygon = self.polygon()?;
        let length = libm::hypot(vector.to[0] - vector.from[0], vector.to[1] - vector.from[1]);
        let one = |a: [f64; 2], b: [f64; 2]| libm::hypot(a[0] - b[0], a[1] - b[1]) <= ONE * length;
        // A head that falls on another one is told to do so, and so is a part that is zero.
        let is_drawn = |v: &Vector| !v.as_point && !v.is_zero;
        let same = |other: &&Vector| {
            let is_same = (other.tail, other.head) == (vector.tail, vector.head)
                || is_drawn(vector)
                    && is_drawn(other)
                    && one(other.from, vector.from)
                    && one(other.to, vector.to);
            is_same && other.quantity != vector.quantity
        };
        let (other, print) = polygon
            .vectors
            .iter()
            .filter(same)
            .find_map(|other| Some((other, figures.print_of(self.key(other))?.clone())))?;
        figures.alias(key, self.key(other));
        let value = human::with_unit(&print.text, &print.unit.symbol);
        let line = self.name(vector).up("\u{a0}= ").then(&self.name(other)).up("\u{a0}= ");
        Some(line.then(&value))
    }

    /// Whether a length is nothing beside the mechanism.
    fn is_nothing(&self, length: f64) -> bool {
        /// As a scene rounds it.
        const ROUNDED: f64 = 1e-9;
        length.abs() <= ROUNDED * self.construction.space.size()
    }

    /// A length that is laid off: as it is stated, or as it is read off what stands.
    fn length_as_told(&self, ends: [PointId; 2], si: f64) -> Rich {
        let n = self.notation;
        let is_it = |own: StatedLength| own.is_between(ends) && (own.length - si).abs() <= 1e-12 * si.abs();
        let mechanism = n.mechanism();
        let own = |link| super::given::dimensions(mechanism.link(link), n);
        if mechanism.moving().flat_map(own).chain(super::given::stated_distances(n)).any(is_it) {
            return super::given::stated_with_unit(si, n);
        }
        let unit = &n.scene.units.length;
        human::with_unit(&human::given(si / unit.si, 0).0, &unit.symbol)
    }

    fn arc_about(&self, ends: [PointId; 2], radius: f64) -> Rich {
        self.arc_told(ends, radius, self.length_as_told(ends, radius))
    }

    fn arc_told(&self, [centre, to]: [PointId; 2], radius: f64, value: Rich) -> Rich {
        let n = self.notation;
        let mm = human::millimetres(radius / self.construction.space.metres_per_mm);
        let parts =
            [("centre", n.point(centre)), ("length", n.length(centre, to)), ("value", value), ("mm", mm)];
        Rich::fill(n.words.strike_arc, &parts)
    }

    /// The pin that stands already, the centre, and the radius of a curved slot about a joint of its link which this step
    /// finds: nobody draws such a slot before its centre stands, which lies on an arc about the pin.
    fn slot_about(&self, index: usize) -> Option<(PointId, PointId, f64)> {
        let slide = self.notation.mechanism().slides.get(index)?;
        let (Rider::Pin { point: pin, .. }, Path::Arc { centre: GuidePoint::Point(centre), radius }) =
            (slide.rider, slide.guide.path)
        else {
            return None;
        };
        let found = |of: PointId| {
            self.step.acts.iter().any(|act| match act {
                Act::TransferPoint { point, .. } | Act::MarkIntersection { point, .. } => *point == of,
                _ => false,
            })
        };
        (slide.guide.link != LinkId::FRAME && found(centre) && !found(pin)).then_some((
            pin,
            centre,
            radius.value,
        ))
    }

    /// The arc about its rider on which the centre of a curved slot lies that is only found in this step, where that centre is
    /// no point of the mechanism.
    fn arc_to_its_centre(&self, index: usize) -> Option<Rich> {
        let (n, words) = (self.notation, self.notation.words);
        let slide = n.mechanism().slides.get(index).filter(|slide| slide.guide.link != LinkId::FRAME)?;
        let (Path::Arc { centre: GuidePoint::Own(_), radius }, Rider::Pin { point: rider, .. }) =
            (slide.guide.path, slide.rider)
        else {
            return None;
        };
        let found = |act: &Act| matches!(act, Act::MarkIntersection { point, .. } if *point == rider);
        if !self.step.links.contains(&slide.guide.link) || self.step.acts.iter().any(found) {
            return None;
        }
        let parts = [
            ("centre", n.point(rider)),
            ("length", Rich::italic("R")),
            ("value", super::given::stated_with_unit(radius.value, n)),
            ("mm", human::millimetres(radius.value / self.construction.space.metres_per_mm)),
        ];
        let first = Rich::fill(words.strike_arc, &parts).up(" ");
        let second = self.centre_of_slot(slide.guide.link, slide.guide.path).map(|(joint, [x, y])| {
            let away = libm::hypot(x, y);
            let mm = human::millimetres(away / self.construction.space.metres_per_mm);
            let value = human::quantity(away, &n.scene.units.length);
            let parts = [("centre", n.point(joint)), ("value", value), ("mm", mm)];
            Rich::fill(words.centre_on_second_arc, &parts)
        });
        Some(first.then(&second.unwrap_or_else(|| Rich::upright(words.centre_on_arc))))
    }

    /// The joint at the origin of a link that carries a curved slot, where it stands already, and the own place of the slot's
    /// centre, metres.
    fn centre_of_slot(&self, link: LinkId, path: Path) -> Option<(PointId, [f64; 2])> {
        let Path::Arc { centre: GuidePoint::Own(own), .. } = path else { return None };
        let link = self.notation.mechanism().link(link);
        let joint = link.points.iter().copied().find(|p| link.has_at_origin(*p) && !self.finds(*p))?;
        Some((joint, own.map(|c| c.value)))
    }

    /// How the own line of a link stands against that to the centre of its curved slot.
    fn angle_from_centre(&self, link: LinkId, base: PointId, point: PointId) -> Option<Rich> {
        let n = self.notation;
        let slides = n.mechanism().slides.iter().filter(|slide| slide.guide.link == link);
        let (joint, [x, y]) =
            slides.filter_map(|slide| self.centre_of_slot(link, slide.guide.path)).next()?;
        let body = n.mechanism().link(link);
        let own_axis = matches!(body.form, Form::Length(_)) && body.points.get(1) == Some(&point);
        if joint != base || !own_axis {
            return None;
        }
        let angle = -libm::atan2(y, x);
        let told = human::degrees(angle.abs()).word(n.sense(angle));
        let parts = [("line", n.length(base, point)), ("angle", told)];
        Some(Rich::fill(n.words.from_centre_line, &parts))
    }

    /// Which guide is drawn, and the parallel to it on which the point lies that is found, where the guide leads another one.
    fn draw_track(&self, index: usize) -> Rich {
        let told = self.draw_guide(index);
        match self.beside_guide(index) {
            Some(parallel) => told.up(" ").then(&parallel),
            None => told,
        }
    }

    /// Whether a point is found in this step.
    fn finds(&self, of: PointId) -> bool {
        self.step.acts.iter().any(|act| match act {
            Act::MarkIntersection { point, .. }
            | Act::LayOffAlong { point, .. }
            | Act::TransferPoint { point, .. } => *point == of,
            Act::LayOffLink { to, .. } | Act::LayOffPlace { to, .. } => *to == of,
            _ => false,
        })
    }

    /// Where a point lies on paper.
    fn at(&self, point: PointId) -> Option<[f64; 2]> {
        self.construction.space.places.get(point.0).copied().flatten()
    }

    /// The parallel to a guide on which a link's point lies, where the guide leads another point of the link and the link's
    /// direction is known: by so much and in this direction from that point, or so far from the guide.
    fn beside_guide(&self, index: usize) -> Option<Rich> {
        let (n, words) = (self.notation, self.notation.words);
        let mechanism = n.mechanism();
        let slide = mechanism.slides.get(index)?;
        let led = self.rider(index).filter(|led| self.finds(*led))?;
        let marked = self.step.acts.iter().find_map(|act| match act {
            Act::MarkIntersection { point, .. } => Some(*point),
            _ => None,
        });
        let marked = marked.filter(|marked| *marked != led)?;
        let has_both = |link: &Link| [led, marked].iter().all(|point| link.points.contains(point));
        let (from, to) = (self.at(led)?, self.at(marked)?);
        let way = [to[0] - from[0], to[1] - from[1]];
        let per_mm = self.construction.space.metres_per_mm;
        let size = |mm: f64| {
            let value = human::quantity(mm * per_mm, &n.scene.units.length);
            [("value", value), ("mm", human::millimetres(mm)), ("point", n.point(marked))]
        };
        if let Rider::Link { link, .. } = slide.rider {
            let Path::Straight { direction: Direction::Angle(angle), turned, .. } = slide.guide.path else {
                return None;
            };
            let (sin, cos) = libm::sincos(angle.value + turned.value);
            let mm = (way[0] * sin - way[1] * cos).abs();
            let told = has_both(mechanism.link(link)) && slide.guide.link == LinkId::FRAME && mm >= 0.05;
            return told.then(|| Rich::fill(words.beside_guide, &size(mm)));
        }
        let driven = |input: &Input| match input {
            Input::Angle { link, .. } => has_both(mechanism.link(*link)),
            _ => false,
        };
        if !mechanism.inputs.iter().any(driven) {
            return None;
        }
        let angle = human::degrees(libm::atan2(way[1], way[0]));
        let line = [("length", n.length(led, marked)), ("angle", angle)];
        Some(Rich::fill(words.shift_guide, &[&size(libm::hypot(way[0], way[1]))[..], &line].concat()))
    }

    /// Which guide is drawn, and where.
    fn draw_guide(&self, index: usize) -> Rich {
        let (n, words) = (self.notation, self.notation.words);
        let guide = || ("guide", n.named_guide(index));
        if let Some(line) = self.guide_before_its_rider(index).or_else(|| self.guide_through_its_rider(index))
        {
            return line;
        }
        if let Some(line) = n.guide_line(index) {
            return Rich::fill(words.draw_guide_along, &[guide(), ("line", line)]);
        }
        if let Some(arc) = self.arc_guide(index) {
            return arc;
        }
        if let Some((named, own, side)) = super::given::beside(index, n) {
            let mm = human::millimetres(own / self.construction.space.metres_per_mm);
            let value = super::given::stated_with_unit(own, n);
            let parts = [("guide", named), ("offset", value), ("mm", mm), ("side", side)];
            return Rich::fill(words.draw_guide_beside, &parts);
        }
        let slide = n.mechanism().slides.get(index).filter(|slide| slide.guide.link == LinkId::FRAME);
        let Some(Path::Straight { through, direction, turned, offset }) = slide.map(|slide| slide.guide.path)
        else {
            return Rich::fill(words.draw_guide, &[guide()]);
        };
        let place = ("place", super::given::place_of(through, n));
        let own = match direction {
            Direction::Angle(angle) => angle.value + turned.value,
            Direction::Toward(target) => {
                let from = match through {
                    GuidePoint::Point(from) => self.at(from),
                    GuidePoint::Own(_) => None,
                };
                let Some((from, to)) = from.zip(self.at(target)) else {
                    return Rich::fill(words.draw_guide, &[guide()]);
                };
                libm::atan2(to[1] - from[1], to[0] - from[0]) + turned.value
            }
        };
        let line = match (direction, through) {
            (Direction::Toward(target), GuidePoint::Point(from)) if turned.value == 0.0 => {
                Some(n.length(from, target))
            }
            _ => None,
        };
        match line {
            _ if n.lie(index).is_some() => Rich::fill(words.draw_guide_through, &[guide(), place]),
            Some(line) if offset.value == 0.0 => {
                Rich::fill(words.draw_guide_along, &[guide(), ("line", line)])
            }
            Some(line) => {
                let aside = offset.value.abs();
                let parts = [
                    guide(),
                    ("line", line.clone()),
                    ("offset", super::given::stated_with_unit(aside, n)),
                    ("mm", human::millimetres(aside / self.construction.space.metres_per_mm)),
                    ("side", super::given::side(own, offset.value, line, words)),
                ];
                Rich::fill(words.draw_guide_parallel, &parts)
            }
            None if offset.value == 0.0 => {
                Rich::fill(words.draw_guide_at, &[guide(), place, ("angle", human::degrees(own))])
            }
            None => Rich::fill(words.draw_guide, &[guide()]),
        }
    }

    /// The arc of a guide about a centre that stands.
    fn arc_guide(&self, index: usize) -> Option<Rich> {
        let (n, words) = (self.notation, self.notation.words);
        let slide = n.mechanism().slides.get(index)?;
        let Path::Arc { centre, radius } = slide.guide.path else { return None };
        let stands = match centre {
            GuidePoint::Point(point) => !self.finds(point),
            GuidePoint::Own(_) => slide.guide.link == LinkId::FRAME,
        };
        if !stands {
            return None;
        }
        let parts = [
            ("centre", super::given::place_of(centre, n)),
            ("length", Rich::italic("R")),
            ("value", super::given::stated_with_unit(radius.value, n)),
            ("mm", human::millimetres(radius.value / self.construction.space.metres_per_mm)),
        ];
        let own = Rich::fill(words.arc_is_guide, &[("guide", n.named_guide(index))]);
        Some(Rich::fill(words.strike_arc, &parts).up(" ").then(&own))
    }

    /// An angle as the scene states it for an input: 200°, not −160°.
    fn as_given(&self, angle: f64) -> f64 {
        let turn = std::f64::consts::TAU;
        let same = |given: &f64| given.abs() <= turn && libm::remainder(given - angle, turn).abs() < 1e-9;
        let mut given = self.notation.scene.input_units.iter().filter_map(|input| input.angle);
        given.find(same).unwrap_or(angle)
    }

    /// The straight guide of a link that this step lays on its rider, which stands: by its direction, where the link does not
    /// turn against what stands; beside its pivot as a tangent.
    fn guide_through_its_rider(&self, index: usize) -> Option<Rich> {
        let (n, words) = (self.notation, self.notation.words);
        let mechanism = n.mechanism();
        let slide = mechanism.slides.get(index).filter(|slide| slide.guide.link != LinkId::FRAME)?;
        let Path::Straight { through: GuidePoint::Point(base), offset, .. } = slide.guide.path else {
            return None;
        };
        let link = slide.guide.link;
        let rider = self.rider(index).filter(|rider| *rider != base && !self.finds(*rider))?;
        let named = ("guide", n.named_guide(index));
        if !self.step.links.contains(&link) {
            return None;
        }
        if offset.value != 0.0 {
            let radius = offset.value.abs();
            let mm = human::millimetres(radius / self.construction.space.metres_per_mm);
            let value = super::given::stated_with_unit(radius, n);
            let parts =
                [("centre", n.point(base)), ("value", value), ("mm", mm), ("point", n.point(rider)), named];
            return (!self.finds(base)).then(|| Rich::fill(words.tangent_guide, &parts));
        }
        let stands = |other: &LinkId| !self.step.links.contains(other);
        let turned = super::derived::turning_with(link, mechanism).iter().any(stands);
        if !self.finds(base) || !(turned || super::given::only_translates(link, mechanism, 0)) {
            return None;
        }
        let (from, to) = (self.at(base)?, self.at(rider)?);
        let angle = libm::remainder(libm::atan2(to[1] - from[1], to[0] - from[0]), std::f64::consts::PI);
        let place = ("place", n.point(rider));
        Some(Rich::fill(words.draw_guide_at, &[named, place, ("angle", human::degrees(angle))]))
    }

    /// The straight guide of a link that stands, where this step finds its rider: by two points of the link, else by its
    /// angle.
    fn guide_before_its_rider(&self, index: usize) -> Option<Rich> {
        let (n, words) = (self.notation, self.notation.words);
        let slide = n.mechanism().slides.get(index).filter(|slide| slide.guide.link != LinkId::FRAME)?;
        let Path::Straight { through: GuidePoint::Point(base), direction, turned, offset } = slide.guide.path
        else {
            return None;
        };
        if offset.value != 0.0 {
            return None;
        }
        let rider = self.rider(index).filter(|rider| *rider != base)?;
        let finds = |act: &Act| match act {
            Act::MarkIntersection { point, .. } | Act::LayOffAlong { point, .. } => *point == rider,
            _ => false,
        };
        if !self.step.acts.iter().any(finds) {
            return None;
        }
        let along = |target: PointId| {
            let parts = [("guide", n.named_guide(index)), ("line", n.length(base, target))];
            Some(Rich::fill(words.draw_guide_along, &parts))
        };
        if let (Direction::Toward(target), true) = (direction, turned.value == 0.0) {
            return along(target);
        }
        // Another pin stands in the same slot.
        let mut others = n.mechanism().slides.iter().enumerate();
        let other = others.find_map(|(other, own)| {
            let pin = (other != index && own.guide == slide.guide).then(|| self.rider(other))??;
            (pin != base && !self.finds(pin)).then_some(pin)
        });
        if let Some(pin) = other {
            return along(pin);
        }
        let places = &self.construction.space.places;
        let [from, to] = [base, rider].map(|p| places.get(p.0).copied().flatten());
        let (from, to) = (from?, to?);
        let angle = human::degrees(libm::atan2(to[1] - from[1], to[0] - from[0]));
        let place = ("place", super::given::place_of(GuidePoint::Point(base), n));
        Some(Rich::fill(words.draw_guide_at, &[("guide", n.named_guide(index)), place, ("angle", angle)]))
    }

    /// Whether a point is where two lines meet that this step has drawn through standing points: the guide on which the link
    /// rides by it, or slots of the link that lead through it.
    fn is_where_lines_meet(&self, link: LinkId, point: PointId) -> bool {
        let mechanism = self.notation.mechanism();
        let leads_there = |index: usize| {
            let Some(slide) = mechanism.slides.get(index) else { return false };
            match slide.guide.path {
                Path::Straight { through, offset, .. } if offset.value == 0.0 => {
                    let rides = matches!(slide.rider, Rider::Link { link: own, .. } if own == link)
                        && slide.guide.link == LinkId::FRAME
                        && self.rider(index) == Some(point);
                    let carries = slide.guide.link == link && through == GuidePoint::Point(point);
                    rides || carries && self.guide_through_its_rider(index).is_some()
                }
                _ => false,
            }
        };
        let drawn = self.step.acts.iter().filter(|act| match act {
            Act::DrawGuide { slide } => leads_there(*slide),
            _ => false,
        });
        drawn.count() == 2
    }

    /// Which point of a link is marked, and by which of the link's dimensions.
    fn transfer_point(&self, link: LinkId, point: PointId) -> Rich {
        let n = self.notation;
        let per_mm = self.construction.space.metres_per_mm;
        let own = ("point", n.point(point));
        let number = ("link", Rich::upright(n.number(link)));
        let body = n.mechanism().link(link);
        let length = |d: StatedLength| {
            let value = super::given::stated_with_unit(d.length, n);
            let paper = human::millimetres(d.length / per_mm);
            n.length(d.from, d.to).up("\u{a0}=\u{a0}").then(&value).up("\u{a0}(").then(&paper).up(")")
        };
        // Laid off from what stands already.
        let acts = self.step.acts.iter();
        let later: Vec<PointId> = acts
            .filter_map(|act| match act {
                Act::TransferPoint { point, .. } => Some(*point),
                _ => None,
            })
            .skip_while(|other| *other != point)
            .collect();
        let known = |p: PointId| !later.contains(&p);
        let mut touching: Vec<StatedLength> = dimensions(body, n)
            .into_iter()
            .filter(|d| (d.from == point && known(d.to)) || (d.to == point && known(d.from)))
            .collect();
        if let (true, Form::Line(along)) = (touching.is_empty(), &body.form) {
            // From what stands farther along the line.
            let place = |p: PointId| body.points.iter().position(|own| *own == p).and_then(|i| along.get(i));
            let standing = body.points.iter().copied().find(|p| *p != point && known(*p));
            let apart = standing.and_then(|from| {
                let length = (place(from)?.value - place(point)?.value).abs();
                Some(StatedLength { from, to: point, length })
            });
            touching.extend(apart);
        }
        let mut told: Vec<Rich> = touching.iter().copied().map(length).collect();
        let extra = body.points.iter().position(|own| *own == point).and_then(|index| body.extra_at(index));
        if let (Some([along, across]), [first, ..]) = (extra, &body.points[..])
            && across.value == 0.0
            && told.is_empty()
        {
            told.push(length(StatedLength { from: *first, to: point, length: along.value.abs() }));
        }
        if told.is_empty() && (matches!(body.form, Form::Shape(_)) || extra.is_some()) {
            // Two distances lead from what stands to a point that has coordinates of its own.
            let standing = body.points.iter().copied().filter(|p| *p != point && known(*p)).take(2);
            let from = |other: PointId| {
                let (a, b) = (self.at(other)?, self.at(point)?);
                let mm = libm::hypot(a[0] - b[0], a[1] - b[1]);
                let unit = &n.scene.units.length;
                let key = Key::length([other, point]);
                let value = self.figures.borrow_mut().tell(key, mm * per_mm, unit);
                let value = human::with_unit(&value, &unit.symbol);
                let paper = human::millimetres(mm);
                Some(
                    n.length(other, point)
                        .up("\u{a0}=\u{a0}")
                        .then(&value)
                        .up("\u{a0}(")
                        .then(&paper)
                        .up(")"),
                )
            };
            told = standing.filter_map(from).collect();
            // One distance leads to the guide on which the point is, or to a line whose direction is told.
            if told.len() == 1 {
                let standing = body.points.iter().copied().find(|p| *p != point && known(*p));
                let direction = || standing.and_then(|base| self.direction_in_link(link, base, point));
                told.extend(self.guide_led_by(point).or_else(direction));
            }
        }
        if told.is_empty() {
            return Rich::fill(n.words.transfer_point, &[own, number]);
        }
        if let (Form::Arms { angle, .. }, [vertex, one, other]) = (&body.form, &body.points[..]) {
            let name = n.point(*one).then(&n.point(*vertex)).then(&n.point(*other));
            let value = human::degrees(angle.value.abs()).word(n.sense(angle.value));
            told.push(Rich::upright("∠\u{a0}").then(&name).up("\u{a0}=\u{a0}").then(&value));
        }
        // One distance alone leads to no point: along which line is told by what holds the link, and on which side.
        if let (Form::Length(_) | Form::Line(_), [only], [d]) = (&body.form, &mut told[..], &touching[..]) {
            let base = if d.from == point { d.to } else { d.from };
            if let Some(beyond) = self.beyond(link, base, point, &known) {
                *only = only.clone().up(n.words.comma).then(&beyond);
            } else if let Some(slot) = self.slot_beside(link, base, point) {
                told.push(n.claim(Claim::Parallel(Reference::Guide(slot))));
            } else if let Some(angle) = self.angle_from_slot(link, base, point) {
                told.push(angle);
            } else if let Some(angle) = self.angle_from_centre(link, base, point) {
                told.push(angle);
            } else {
                told.extend(self.line_of(link));
            }
        }
        Rich::fill(n.words.transfer_point_lengths, &[own, number, ("lengths", n.list(&told))])
    }

    /// That a link's own point is on its guide on the frame.
    fn guide_led_by(&self, point: PointId) -> Option<Rich> {
        let n = self.notation;
        let slides = &n.mechanism().slides;
        let led = (0..slides.len())
            .find(|index| slides[*index].guide.link == LinkId::FRAME && self.rider(*index) == Some(point))?;
        Some(Rich::fill(n.words.stated_on, &[("point", n.point(point)), ("line", n.named_guide(led))]))
    }

    /// That a point of a straight link lies on the other side of the point from which it is laid off than what else stands on
    /// the link's line: another joint, or the pin in the slot along it.
    fn beyond(
        &self,
        link: LinkId,
        base: PointId,
        point: PointId,
        known: &dyn Fn(PointId) -> bool,
    ) -> Option<Rich> {
        let n = self.notation;
        let mechanism = n.mechanism();
        let body = mechanism.link(link);
        let joint = body.points.iter().copied().find(|p| ![base, point].contains(p) && known(*p));
        let joint = joint.filter(|_| matches!(body.form, Form::Line(_)));
        let slotted = || {
            let own = |slide: &Slide| {
                slide.guide.link == link
                    && matches!(slide.guide.path, Path::Straight { through: GuidePoint::Point(p), direction: Direction::Toward(to), turned, offset }
                        if p == base && to == point && turned.value == 0.0 && offset.value == 0.0)
            };
            let index = mechanism.slides.iter().position(own)?;
            self.rider(index).filter(|rider| *rider != base)
        };
        let other = joint.or_else(slotted)?;
        let (from, to, other) = (self.at(base)?, self.at(point)?, self.at(other)?);
        let along = (to[0] - from[0]) * (other[0] - from[0]) + (to[1] - from[1]) * (other[1] - from[1]);
        (along < 0.0).then(|| Rich::fill(n.words.beyond, &[("point", n.point(base))]))
    }

    /// The slot of a link that lies beside the line between two of its points.
    fn slot_beside(&self, link: LinkId, base: PointId, point: PointId) -> Option<usize> {
        self.notation.mechanism().slides.iter().position(|slide| {
            slide.guide.link == link
                && match slide.guide.path {
                    Path::Straight {
                        through: GuidePoint::Point(from),
                        direction: Direction::Toward(to),
                        turned,
                        offset,
                    } => (from, to, turned.value) == (base, point, 0.0) && offset.value != 0.0,
                    _ => false,
                }
        })
    }

    /// The angle at the pivot of a slotted link between the pin in its slot and another point, where the slot is not along
    /// the link's own line.
    fn angle_from_slot(&self, link: LinkId, base: PointId, point: PointId) -> Option<Rich> {
        /// As a scene rounds it.
        const ROUNDED: f64 = 1e-9;
        let n = self.notation;
        let oblique = |slide: &Slide| match slide.guide.path {
            Path::Straight {
                through: GuidePoint::Point(p),
                direction: Direction::Angle(angle),
                turned,
                offset,
            } => p == base && offset.value == 0.0 && libm::sin(angle.value + turned.value).abs() > ROUNDED,
            _ => false,
        };
        let slides = &n.mechanism().slides;
        let index = slides.iter().position(|slide| slide.guide.link == link && oblique(slide))?;
        let pin = self.rider(index).filter(|pin| ![base, point].contains(pin))?;
        let (from, to, pin_at) = (self.at(base)?, self.at(point)?, self.at(pin)?);
        let toward = |p: [f64; 2]| libm::atan2(p[1] - from[1], p[0] - from[0]);
        let angle = libm::remainder(toward(to) - toward(pin_at), std::f64::consts::TAU);
        let name = n.point(pin).then(&n.point(base)).then(&n.point(point));
        let value = human::degrees(angle.abs()).word(n.sense(angle));
        Some(Rich::upright("∠\u{a0}").then(&name).up("\u{a0}=\u{a0}").then(&value))
    }

    /// The direction of a link's own line: that of its input, or the guide along which it slides without turning against it.
    fn line_of(&self, link: LinkId) -> Option<Rich> {
        let n = self.notation;
        let driven = n.mechanism().inputs.iter().find_map(|input| match input {
            Input::Angle { link: own, angle: Some(angle), .. } if *own == link => Some(angle.value),
            _ => None,
        });
        if let Some(angle) = driven {
            let symbol = n.symbol(Quantity::Angle(link), false);
            return Some(symbol.up("\u{a0}=\u{a0}").then(&human::degrees(angle)));
        }
        let (sign, line) =
            n.mechanism().slides.iter().find_map(|slide| super::given::held_along(slide, link, n))?;
        Some(Rich::upright(sign).up("\u{a0}").then(&line))
    }

    /// The direction from one point of a link to another, both by own coordinates: against the line to the centre of the arc
    /// that the link carries, or against the horizontal where a guide of the frame keeps the link from turning.
    fn direction_in_link(&self, link: LinkId, base: PointId, point: PointId) -> Option<Rich> {
        let n = self.notation;
        let body = n.mechanism().link(link);
        let own = |p: PointId| {
            let index = body.points.iter().position(|of| *of == p)?;
            match &body.form {
                Form::Shape(places) => places.get(index).map(|at| at.map(|given| given.value)),
                _ => None,
            }
        };
        let slides = &n.mechanism().slides;
        let carried = slides.iter().filter(|slide| slide.guide.link == link);
        let centre = carried.filter_map(|slide| self.centre_of_slot(link, slide.guide.path)).next();
        if let (Some((joint, [x, y])), Some(from), Some(to)) = (centre, own(base), own(point))
            && joint == base
        {
            let turned = libm::atan2(to[1] - from[1], to[0] - from[0]) - libm::atan2(y, x);
            let angle = libm::remainder(turned, std::f64::consts::TAU);
            let told = human::degrees(angle.abs()).word(n.sense(angle));
            let parts = [("line", n.length(base, point)), ("angle", told)];
            return Some(Rich::fill(n.words.from_centre_line, &parts));
        }
        let is_held = super::given::only_translates(link, n.mechanism(), 0);
        let (from, to) = (self.at(base)?, self.at(point)?);
        let angle = libm::atan2(to[1] - from[1], to[0] - from[0]);
        let parts = [("line", n.length(base, point)), ("angle", human::degrees(angle))];
        is_held.then(|| Rich::fill(n.words.stated_ray, &parts))
    }

    /// Whether a vector ends in a known point and begins in a new one.
    fn is_drawn_backwards(&self, vector: &Vector) -> bool {
        let earlier = self.polygon().into_iter().flat_map(|p| &p.vectors).take_while(|v| *v != vector);
        let mut ends = earlier.flat_map(|v| [v.tail, v.head]);
        matches!(vector.tail, Label::Foot { .. }) && !ends.any(|end| end == vector.tail)
    }

    /// The direction in which a vector is laid off, with its sense.
    fn direction_of(&self, vector: &Vector) -> Rich {
        let n = self.notation;
        let comma = |a: Rich, b: Rich| if a.is_empty() { b } else { a.aside(n.words.comma, &b) };
        // Parallel or square to nothing that has a name: by its angle.
        let Some(claim) = vector.claim else { return self.angle_of(vector) };
        if vector.kind == VectorKind::Coriolis && self.is_drawn_backwards(vector) {
            let head = ("head", n.image(vector.head, self.step.diagram));
            return comma(n.claim(claim), Rich::fill(n.words.head_first, &[head]));
        }
        match claim {
            Claim::Parallel(Reference::Points(p, q)) => {
                let places = &self.construction.space.places;
                let place = |p: PointId| places.get(p.0).copied().flatten();
                let (Some(a), Some(b)) = (place(p), place(q)) else { return n.claim(claim) };
                let along = (b[0] - a[0]) * (vector.to[0] - vector.from[0])
                    + (b[1] - a[1]) * (vector.to[1] - vector.from[1]);
                let (p, q) = if along < 0.0 { (q, p) } else { (p, q) };
                Rich::upright("∥\u{a0}").then(&n.point(p)).up(WAY).then(&n.point(q))
            }
            Claim::Perpendicular(Reference::Points(p, q)) => {
                let carries = |l: &LinkId| {
                    let points = &n.mechanism().link(*l).points;
                    points.contains(&p) && points.contains(&q)
                };
                let turned = self.turned_by(vector.quantity);
                let Some(link) = turned.or_else(|| n.mechanism().moving().find(carries)) else {
                    return comma(n.claim(claim), self.angle_of(vector));
                };
                // Of a wheel that rolls on what rests the whole acceleration of the centre is α r.
                let rotation = match (vector.kind, self.step.diagram) {
                    (VectorKind::Tangential, _) | (_, DiagramKind::Acceleration) => Quantity::Alpha(link),
                    _ => Quantity::Omega(link),
                };
                let sense = Rich::fill(n.words.in_sense_of, &[("rotation", n.symbol(rotation, false))]);
                comma(n.claim(claim), sense)
            }
            Claim::Perpendicular(Reference::Guide(_)) if vector.kind == VectorKind::Normal => {
                Rich::upright(n.words.toward_centre)
            }
            // Its way was told with its size.
            _ if vector.kind == VectorKind::Coriolis && !n.claim(claim).is_empty() => n.claim(claim),
            _ => comma(n.claim(claim), self.way_of(vector)),
        }
    }

    /// The link from whose rotation a vector was calculated in this step.
    fn turned_by(&self, of: Quantity) -> Option<LinkId> {
        self.step.acts.iter().find_map(|act| match act {
            Act::Calculate(
                Calculation::Speed { quantity, link, .. } | Calculation::Tangential { quantity, link, .. },
            ) if *quantity == of => Some(*link),
            _ => None,
        })
    }

    /// Which of the two ways along a line a vector points: in the sense of its velocity or against it, else by its angle.
    fn way_of(&self, vector: &Vector) -> Rich {
        let n = self.notation;
        let velocity = match vector.quantity {
            Quantity::Acceleration(point) => Quantity::Velocity(point),
            Quantity::SlipAcceleration(point, link) => Quantity::Slip(point, link),
            _ => return self.angle_of(vector),
        };
        let polygon = self.construction.diagram(DiagramKind::Velocity);
        let drawn = polygon.and_then(|polygon| polygon.vectors.iter().find(|v| v.quantity == velocity));
        let Some(drawn) = drawn.filter(|v| !v.as_point) else { return self.angle_of(vector) };
        let part = |axis: usize| (vector.to[axis] - vector.from[axis]) * (drawn.to[axis] - drawn.from[axis]);
        let template = if part(0) + part(1) < 0.0 { n.words.against_sense_of } else { n.words.in_sense_of };
        Rich::fill(template, &[("rotation", n.symbol(velocity, false))])
    }

    /// The angle of a vector from the x axis.
    fn angle_of(&self, vector: &Vector) -> Rich {
        let [x, y] = [0, 1].map(|axis| vector.to[axis] - vector.from[axis]);
        Rich::upright("∠\u{a0}").then(&human::degrees(libm::atan2(y, x)))
    }

    /// Which ω Coriolis takes, and which way it points.
    fn coriolis_rule(&self, link: LinkId, slip: Quantity, omega: f64) -> Rich {
        let n = self.notation;
        Rich::fill(
            n.words.coriolis_rule,
            &[
                ("omega", n.symbol(Quantity::Omega(link), false)),
                ("link", Rich::upright(n.number(link))),
                ("slip", n.symbol(slip, false)),
                ("sense", Rich::upright(n.sense(omega))),
            ],
        )
    }

    fn calculation(&self, calculation: &Calculation) -> Option<Rich> {
        let n = self.notation;
        let equals = "\u{a0}= ";
        let length = &n.scene.units.length;
        let (v, a) = (n.unit(Dimension::Velocity), n.unit(Dimension::Acceleration));
        let (w, e) = (n.angular_unit(Order::Velocity), n.angular_unit(Order::Acceleration));
        let times = "\u{a0}·\u{a0}";
        let cross = "\u{a0}×\u{a0}";
        let over = "\u{a0}/\u{a0}";
        let rule = |link: &LinkId, slip: &Quantity, omega: &f64, speed: &f64| {
            // What is zero has no direction.
            if *omega == 0.0 || *speed == 0.0 {
                return Rich::default();
            }
            self.coriolis_rule(*link, *slip, *omega)
        };
        let ruled = |formula: Rich, rule: Rich| {
            if rule.is_empty() { formula } else { formula.aside(n.words.semicolon, &rule) }
        };
        // What is computed, by which formula, from which numbers, and what it comes to.
        let line = |of: Rich, formula: Rich, numbers: Rich, value: Rich| {
            of.up(equals).then(&formula).up(equals).then(&numbers).up(equals).then(&value)
        };
        let vector = |quantity: &Quantity, from: PointId| n.symbol_from(*quantity, Some(from), false);
        let rotation = |quantity: Quantity| n.symbol(quantity, false);
        let of = |quantity: Quantity, si: f64, unit| (Key::of(quantity, n), si, unit);
        let seen =
            |quantity: Quantity, from: PointId, si: f64, unit| (Key::from(quantity, Some(from), n), si, unit);
        let between = |ends: [PointId; 2], si: f64| (Key::length(ends), si, length);
        let close = |factors, result, reckon: &dyn Fn([f64; 2]) -> f64| {
            self.figures.borrow_mut().line::<2>(factors, result, reckon)
        };
        let close_one = |factors, result, reckon: &dyn Fn([f64; 1]) -> f64| {
            self.figures.borrow_mut().line::<1>(factors, result, reckon)
        };
        let text = match calculation {
            Calculation::Speed { quantity, link, ends, omega, length: l, value } => {
                let factors = [of(Quantity::Omega(*link), *omega, &w), between(*ends, *l)];
                let ([rate, size], result) =
                    close(factors, seen(*quantity, ends[0], *value, &v), &|[a, b]| a * b);
                line(
                    vector(quantity, ends[0]),
                    rotation(Quantity::Omega(*link)).up(times).then(&n.length(ends[0], ends[1])),
                    rate.up(cross).then(&size),
                    human::with_unit(&result, &v.symbol),
                )
            }
            Calculation::Omega { link, quantity, ends, speed, length: l, value } => {
                let factors = [seen(*quantity, ends[0], *speed, &v), between(*ends, *l)];
                let result = of(Quantity::Omega(*link), *value, &w);
                let ([read, size], result) = close(factors, result, &|[a, b]| a / b);
                line(
                    rotation(Quantity::Omega(*link)),
                    vector(quantity, ends[0]).up(over).then(&n.length(ends[0], ends[1])),
                    read.up(over).then(&size),
                    n.with_sense(human::with_unit(&result, &w.symbol), *value),
                )
            }
            // At a joint nothing turns about it: no line leads from the one to the other.
            Calculation::Normal { length: l, .. } if self.is_nothing(*l) => return None,
            Calculation::Normal { quantity, velocity, ends, speed, length: l, value } => {
                let factors = [seen(*velocity, ends[0], *speed, &v), between(*ends, *l)];
                let ([read, size], result) =
                    close(factors, seen(*quantity, ends[0], *value, &a), &|[x, l]| x * x / l);
                line(
                    vector(quantity, ends[0]),
                    vector(velocity, ends[0]).squared().up(over).then(&n.length(ends[0], ends[1])),
                    read.up("²").up(over).then(&size),
                    human::with_unit(&result, &a.symbol),
                )
            }
            Calculation::Tangential { quantity, link, ends, alpha, length: l, value } => {
                let factors = [of(Quantity::Alpha(*link), *alpha, &e), between(*ends, *l)];
                let ([rate, size], result) =
                    close(factors, seen(*quantity, ends[0], *value, &a), &|[a, b]| a * b);
                line(
                    vector(quantity, ends[0]),
                    rotation(Quantity::Alpha(*link)).up(times).then(&n.length(ends[0], ends[1])),
                    rate.up(cross).then(&size),
                    human::with_unit(&result, &a.symbol),
                )
            }
            Calculation::Alpha { link, quantity, ends, tangential, length: l, value } => {
                let factors = [seen(*quantity, ends[0], *tangential, &a), between(*ends, *l)];
                let result = of(Quantity::Alpha(*link), *value, &e);
                let ([read, size], result) = close(factors, result, &|[a, b]| a / b);
                line(
                    rotation(Quantity::Alpha(*link)),
                    vector(quantity, ends[0]).up(over).then(&n.length(ends[0], ends[1])),
                    read.up(over).then(&size),
                    n.with_sense(human::with_unit(&result, &e.symbol), *value),
                )
            }
            Calculation::Coriolis { quantity, link, slip, speed, omega, value } => {
                let factors = [of(*slip, *speed, &v), of(Quantity::Omega(*link), *omega, &w)];
                let result = of(*quantity, *value, &a);
                let ([read, rate], result) = close(factors, result, &|[x, w]| 2.0 * x * w);
                let omega_of = rotation(Quantity::Omega(*link));
                let formula = line(
                    n.symbol(*quantity, false),
                    Rich::upright("2").up(times).then(&n.symbol(*slip, false)).up(times).then(&omega_of),
                    Rich::upright("2").up(cross).then(&read).up(cross).then(&rate),
                    human::with_unit(&result, &a.symbol),
                );
                ruled(formula, rule(link, slip, omega, speed))
            }
            Calculation::SlipNormal { quantity, slip, speed, radius, value } => {
                let size = super::given::stated_length(*radius, n);
                let own = super::given::stated_number(*radius, n);
                let slip = absolute(*slip, n);
                let factors = [of(slip, *speed, &v)];
                let ([read], result) = close_one(factors, of(*quantity, *value, &a), &|[x]| x * x / own);
                line(
                    n.symbol(*quantity, false),
                    n.symbol(slip, false).squared().up(over).it("R"),
                    read.up("²").up(over).then(&size),
                    human::with_unit(&result, &a.symbol),
                )
            }
            Calculation::Translation { link } => {
                let omega = match self.step.diagram {
                    DiagramKind::Acceleration => Quantity::Alpha(*link),
                    _ => Quantity::Omega(*link),
                };
                Rich::fill(
                    n.words.translation,
                    &[("link", Rich::upright(n.number(*link))), ("omega", n.symbol(omega, false))],
                )
            }
            Calculation::Rub { pin, links, radius, first, second, value } => {
                let quantity = Quantity::Rub(*pin, links[0], links[1]);
                let unit = n.mechanism().asked.iter().find(|q| q.quantity == quantity);
                let unit = unit.map_or_else(|| v.clone(), |asked| asked.unit.clone());
                let length = human::length_of(&unit).unwrap_or_else(|| length.clone());
                let journal = radius / length.si;
                // The larger first: what is left of it, or both together where they turn against each other.
                let mut rates: Vec<(LinkId, f64)> = [(links[0], *first), (links[1], *second)]
                    .into_iter()
                    .filter(|(_, rate)| *rate != 0.0)
                    .collect();
                rates.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
                let factors: Vec<(Option<Key>, f64, &Unit)> = rates
                    .iter()
                    .map(|(link, rate)| (Some(Key::of(Quantity::Omega(*link), n)), *rate, &w))
                    .collect();
                let (less, sign) =
                    if first * second < 0.0 { (1.0, "\u{a0}+\u{a0}") } else { (-1.0, "\u{a0}−\u{a0}") };
                let result = (Some(Key::of(quantity, n)), *value, &unit);
                let (numbers, result, _) = self.figures.borrow_mut().line_of(&factors, result, |x| {
                    journal * x.iter().zip([1.0, less]).map(|(own, sign)| sign * own).sum::<f64>()
                });
                let difference = Rich::join(&numbers, &Rich::upright(sign));
                let difference = match numbers.len() {
                    2 => Rich::upright("(").then(&difference).up(")"),
                    _ => difference,
                };
                let between = rotation(Quantity::Omega(links[0]))
                    .up("\u{a0}−\u{a0}")
                    .then(&rotation(Quantity::Omega(links[1])));
                line(
                    n.symbol(quantity, false),
                    Rich::italic("r").up("\u{a0}|").then(&between).up("|"),
                    human::stated_quantity(*radius, &length).up(cross).then(&difference),
                    human::with_unit(&result, &unit.symbol),
                )
            }
        };
        Some(text)
    }
}
