//! What a student handed in: values, lengths measured on the drawing, and points read off the paper, as JSON, as
//! CSV, or as the drawing itself.

use std::borrow::Cow;

use super::digits::{
    refuse_decimal_comma, with_plain_digits, with_plain_numbers, with_plain_sense, with_plain_unit,
};
use super::scan::Scan;
use super::unread::{Missed, Unread, refuse_bare, spans};
use crate::limits;
use crate::mechanism::Sense;
use crate::mechanism::cycle::CycleQuantity;
use crate::mechanism::force::Force;
use crate::mechanism::quantity::{Asked, Dimension, Nature, Order, Quantity, Unit};
use crate::scene::asked::{Names, default_scale};
use crate::scene::diagnostic::{Fault, Res};
use crate::scene::json::{self, Entry, Fields, Kind, Value};
use crate::scene::units::{Measure, Scale, Scales, Words, drawing_scale, number};
use crate::scene::{Diagnostic, Scene};

const ANSWERS: &[&str] = &[
    "$schema",
    "student",
    "variant",
    "units",
    "values",
    "scales",
    "lengths",
    "points",
    "scan",
    "drawing",
    "tolerance",
];
const SCALES: &[&str] = &["length", "velocity", "acceleration", "force"];
const FIGURES: &[&str] = &["velocity", "acceleration", "skeleton"];
const VALUE: &[&str] = &["value", "magnitude", "direction", "sense", "components", "unit", "through"];
const SCAN: &[&str] = &["pixels", "mm"];

/// What a student handed in.
#[derive(Debug, Clone, PartialEq)]
pub struct Answers {
    /// The student's name, where it is told.
    pub student: Option<String>,
    /// Values and measured lengths, in the order of the file.
    pub items: Vec<Item>,
    /// The scale factors of the student's drawing.
    pub scales: StatedScales,
    /// Points of the drawing.
    pub figures: Vec<FigurePoints>,
    /// How exact the hand is taken to be, millimetres and radians, where the file says it; it counts where
    /// [`GradeSettings::trusts_answers`](super::GradeSettings::trusts_answers) says so.
    pub hand: (Option<f64>, Option<f64>),
    /// Tolerances that the file states, by the name of the quantity; they count where the hand does.
    pub tolerances: Vec<(String, Tolerance)>,
    /// The file of the drawing, where the answers name one: it is read by [`Answers::add_drawing`].
    pub drawing: Option<String>,
    /// Where the file names it; 0 where it does not.
    pub drawing_at: usize,
    /// The variant of an exam to which the answers belong, where that is another one: then each is right or wrong, and
    /// nothing follows from it.
    pub other_variant: Option<String>,
    /// What the scene asks: what it asks twice may be answered twice.
    pub(super) asked: Vec<Quantity>,
    /// Where each scale stands in the file.
    pub(super) scales_at: [usize; Dimension::ALL.len()],
    /// The scales that the file states and nobody understands: what was measured by them tells nothing.
    lost_scales: Vec<&'static str>,
    /// Fields that were not understood.
    pub(super) missed: Vec<Missed>,
    /// The same of what stands in other files.
    pub(super) elsewhere: Vec<Unread>,
    pub(super) file: String,
    pub(super) text: String,
}

/// One value or measured length.
#[derive(Debug, Clone, PartialEq)]
pub struct Item {
    /// What it is of; its unit is the one in which it was written.
    pub asked: Asked,
    /// What was written.
    pub given: Given,
    /// In which form it was written.
    pub form: Form,
    /// It is a rotation whose sense is said by a minus sign.
    pub minus: bool,
    /// A point of the line of a force, metres in the world, where one is told.
    pub through: Option<[f64; 2]>,
    /// Half a unit in its last place, in the unit of `given`.
    pub rounding: f64,
    /// Where it stands in the file.
    pub at: usize,
}

impl Item {
    /// Whether it is a length that was measured on the drawing.
    pub(super) fn is_drawn(&self) -> bool {
        matches!(self.given, Given::Drawn(_))
    }
}

/// In which form somebody writes an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// A number, or a magnitude alone.
    Number,
    /// A magnitude with a direction.
    Polar,
    /// Two components.
    Components,
    /// Millimetres of paper: a length, or a point of the drawing.
    Paper,
}

/// What was written of a quantity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Given {
    /// How large it is, SI; nothing is said of its sense or direction.
    Magnitude(f64),
    /// A number with its sign, SI.
    Signed(f64),
    /// Both components, SI.
    Vector([f64; 2]),
    /// The length of its vector on the drawing, millimetres.
    Drawn(f64),
}

/// The scale factors of a drawing, where they are stated: SI units per millimetre of paper.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StatedScales([Option<f64>; Dimension::ALL.len()], Option<f64>);

impl StatedScales {
    /// The scale of a dimension, where it is stated.
    #[must_use]
    pub const fn of(&self, dimension: Dimension) -> Option<f64> {
        self.0[dimension as usize]
    }

    /// Takes the scale that a figure says of itself, where the answers state none for it.
    pub(super) fn tell(&mut self, order: Order, si_per_mm: Option<f64>) {
        let known = &mut self.0[order.dimension() as usize];
        *known = known.or(si_per_mm);
    }

    /// Newtons per millimetre of the force polygons, where it is stated.
    #[must_use]
    pub const fn force(&self) -> Option<f64> {
        self.1
    }
}

/// Points that were read off one figure, millimetres of paper, x right, y up, from any origin.
#[derive(Debug, Clone, PartialEq)]
pub struct FigurePoints {
    /// The skeleton, the velocity polygon or the acceleration polygon.
    pub order: Order,
    /// Name, place, and where it stands in the file.
    pub points: Vec<(String, [f64; 2], usize)>,
    /// Two points each (by their index) whose letters stand beside one mark of a drawing, which nothing but the right
    /// solution can tell to be both.
    pub shared: Vec<[usize; 2]>,
}

/// By how much an answer may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Tolerance {
    /// This part of the right value.
    Part(f64),
    /// This much, SI.
    Amount(f64),
}

impl Answers {
    /// What is wrong with the answers, with its line and column.
    #[must_use]
    pub fn complain(&self, at: usize, what: impl Into<String>, mend: Option<String>) -> Diagnostic {
        let fault = Fault::new(at, what);
        let fault = mend.into_iter().fold(fault, Fault::mend);
        let document = json::parse(&self.text).ok();
        fault.locate(&self.file, &self.text, document.as_ref().map(|d| &d.root))
    }

    /// Takes the points of a drawing (the SVG of a vector editor) beside what the answers say themselves; `file` is
    /// named in diagnostics. A letter whose mark nobody can tell is among the [`Answers::unread`].
    ///
    /// # Errors
    /// A text that is no SVG, one of which no letter is understood, or a figure of which the answers have points already.
    pub fn add_drawing(&mut self, svg: &str, file: &str, scene: &Scene) -> Result<(), Diagnostic> {
        let drawing = super::drawing::points(svg, scene).map_err(|fault| fault.locate(file, svg, None))?;
        // What is wrong with a point of the drawing is told at the key that names the drawing.
        let at = self.drawing_at;
        for (mut figure, scale) in drawing.figures {
            if self.figures.iter().any(|known| known.order == figure.order) {
                let what = "the points of one figure stand in `points` and in the drawing";
                return Err(self.complain(at, what, Some("keep one of the two".to_owned())));
            }
            if self.lost_scales.contains(&scale_of(figure.order)) {
                return Err(self.complain(at, WITHOUT_SCALE, None));
            }
            figure.points.iter_mut().for_each(|(.., place)| *place = at);
            self.scales.tell(figure.order, scale);
            self.figures.push(figure);
        }
        let located = |(name, fault): (String, Fault)| {
            let why = fault.locate(file, svg, None);
            Unread { name, quantity: None, why }
        };
        self.elsewhere.extend(drawing.open.into_iter().map(located));
        Ok(())
    }

    /// Leaves out the scale of a figure and what was measured by it; that is what is not read for want of it.
    pub(super) fn without_scale(&mut self, order: Order) -> Vec<Unread> {
        self.scales.0[order.dimension() as usize] = None;
        let measured = |item: &Item| {
            let force = matches!(item.asked.quantity, Quantity::Force(..));
            item.is_drawn() && !force && item.asked.quantity.order() == order
        };
        let (lost, left) = std::mem::take(&mut self.items).into_iter().partition(measured);
        self.items = left;
        let (figures, left) = std::mem::take(&mut self.figures).into_iter().partition(|f| f.order == order);
        self.figures = left;
        let (lost, figures): (Vec<Item>, Vec<FigurePoints>) = (lost, figures);
        let why = |at: usize| self.complain(at, WITHOUT_SCALE, None);
        let lost = lost.into_iter().map(|Item { asked, at, .. }| Unread {
            name: asked.name,
            quantity: Some(asked.quantity),
            why: why(at),
        });
        let figures = figures.into_iter().map(|figure| Unread {
            name: format!("points.{}", super::case::figure_name(order)),
            quantity: None,
            why: why(figure.points.first().map_or(0, |(.., at)| *at)),
        });
        lost.chain(figures).collect()
    }

    /// The values, without lengths that were measured on the drawing.
    pub(super) fn values(&self) -> impl Iterator<Item = &Item> {
        self.items.iter().filter(|item| !item.is_drawn())
    }

    /// Where one rotation has a minus sign, those without a sign or a sense turn counter-clockwise; likewise torques.
    pub(super) fn take_plus_for_a_sense(&mut self) {
        for alike in [is_rate, is_torque] {
            if !self.items.iter().any(|item| item.minus && alike(&item.asked.quantity)) {
                continue;
            }
            for item in self.items.iter_mut().filter(|item| alike(&item.asked.quantity)) {
                if let Given::Magnitude(size) = item.given {
                    item.given = Given::Signed(size);
                }
            }
        }
    }

    /// Refuses one answer more than anybody hands in.
    pub(super) fn count(&self, at: usize) -> Res<()> {
        let points: usize = self.figures.iter().map(|figure| figure.points.len()).sum();
        if self.items.len() + points + self.missed.len() < limits::ANSWERS {
            return Ok(());
        }
        Err(Fault::new(at, format!("more than {} answers", limits::grouped(limits::ANSWERS))))
    }

    /// As if all that a scene asks had been answered with nothing: what may be said of it before anybody answers.
    pub(super) fn of_asked(scene: &Scene) -> Self {
        let item = |asked: &Asked| {
            let given = if is_vector(&asked.quantity) { Given::Vector([0.0; 2]) } else { Given::Signed(0.0) };
            let place = crate::tolerance::is_place(&asked.quantity);
            let form = if place { Form::Components } else { Form::Polar };
            let asked = asked.clone();
            Item { asked, given, form, minus: false, through: None, rounding: 0.0, at: 0 }
        };
        let items = scene.mechanism.asked.iter().map(item).collect();
        Self { items, ..Self::none("", "") }
    }

    fn none(file: &str, text: &str) -> Self {
        Self {
            student: None,
            items: Vec::new(),
            scales: StatedScales::default(),
            figures: Vec::new(),
            hand: (None, None),
            tolerances: Vec::new(),
            drawing: None,
            drawing_at: 0,
            other_variant: None,
            asked: Vec::new(),
            scales_at: [0; Dimension::ALL.len()],
            lost_scales: Vec::new(),
            missed: Vec::new(),
            elsewhere: Vec::new(),
            file: file.to_owned(),
            text: text.to_owned(),
        }
    }

    /// Whether the file states how exact it is to be graded.
    pub(super) fn state_tolerances(&self) -> bool {
        self.hand != (None, None) || !self.tolerances.is_empty()
    }

    /// Whether nothing was handed in.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.items.is_empty() && self.figures.iter().all(|f| f.points.is_empty())
    }
}

/// Reads the answers to a scene, as JSON, as CSV, or as the SVG of a drawing. A field that is not understood answers
/// nothing, and is among the [`Answers::unread`].
///
/// # Errors
/// A text that is neither of these, is beyond the limits, or of which nothing is understood: the first thing that is wrong
/// with it, with its place and its mend.
pub fn read_answers(text: &str, scene: &Scene) -> Result<Answers, Diagnostic> {
    read_named(text, "answers", scene)
}

/// As [`read_answers`]; `file` is named in diagnostics.
///
/// # Errors
/// See [`read_answers`].
pub fn read_named(text: &str, file: &str, scene: &Scene) -> Result<Answers, Diagnostic> {
    let begin = text.trim_start_matches('\u{feff}').trim_start();
    let plain = if begin.starts_with('{') { with_plain_numbers(text) } else { Cow::Borrowed(text) };
    let text = &*plain;
    let asked = scene.mechanism.asked.iter().map(|asked| asked.quantity).collect();
    let empty = Answers { asked, ..Answers::none(file, text) };
    if begin.starts_with('<') {
        return super::drawing::read(text, scene, empty).map_err(|fault| fault.locate(file, text, None));
    }
    if !begin.starts_with('{') {
        let answers = super::csv::read(text, scene, empty).and_then(something);
        return answers.map_err(|fault| fault.locate(file, text, None));
    }
    let json::Document { mut root, fault, twice } =
        json::parse(text).map_err(|fault| fault.locate(file, text, None))?;
    read_digits(&mut root, None);
    let limited = fault.map_or(Ok(()), Err);
    let answers = limited.and_then(|()| answers(&root, scene, empty, &twice)).and_then(something);
    answers.map_err(|fault| fault.locate(file, text, Some(&root)))
}

/// Answers of which something is understood, or in which there is nothing to be understood.
fn something(mut answers: Answers) -> Res<Answers> {
    let nothing = answers.is_empty() && answers.drawing.is_none();
    match answers.missed.is_empty() {
        false if nothing => Err(answers.missed.swap_remove(0).fault),
        _ => Ok(answers),
    }
}

/// Refuses a text that is no JSON, with its place; `file` is named.
#[cfg(feature = "cli")]
pub(crate) fn refuse_broken(text: &str, file: &str) -> Result<(), Diagnostic> {
    let plain = with_plain_numbers(text);
    let document = json::parse(&plain).map_err(|fault| fault.locate(file, &plain, None))?;
    document.fault.map_or(Ok(()), |fault| Err(fault.locate(file, &plain, Some(&document.root))))
}

/// Turns the digits of Persian and Arabic into those of ASCII; names of people and files stay as they are.
fn read_digits(value: &mut Value<'_>, key: Option<&str>) {
    match &mut value.kind {
        Kind::Text(text) if !key.is_some_and(|key| NAMES.contains(&key)) => {
            if let Cow::Owned(plain) = with_plain_digits(text) {
                *text = plain;
            }
            if let Cow::Owned(plain) = with_plain_sense(text) {
                *text = plain;
            }
            if let Cow::Owned(plain) = with_plain_unit(text) {
                *text = plain;
            }
        }
        Kind::List(list) => list.iter_mut().for_each(|one| read_digits(one, None)),
        Kind::Object(entries) => {
            for entry in entries {
                if let Cow::Owned(plain) = with_plain_digits(&entry.key) {
                    entry.key = plain;
                }
                read_digits(&mut entry.value, Some(&entry.key));
            }
        }
        _ => {}
    }
}

/// Names a decimal comma for what it is, wherever it stands in a value.
fn refuse_commas(value: &Value<'_>) -> Res<()> {
    match &value.kind {
        Kind::Text(text) => refuse_decimal_comma(text, value.at),
        Kind::List(list) => list.iter().try_for_each(refuse_commas),
        Kind::Object(entries) => entries.iter().try_for_each(|entry| refuse_commas(&entry.value)),
        _ => Ok(()),
    }
}

/// Texts that are no answers.
const NAMES: [&str; 3] = ["$schema", "student", "drawing"];

fn answers(root: &Value<'_>, scene: &Scene, answers: Answers, twice: &[Fault]) -> Res<Answers> {
    let expected = "answers: {\"values\": {\"v(B)\": \"170 cm/s\"}, …}";
    let fields = Fields::among(root, ANSWERS, expected)?;
    let all = root.object(expected)?;
    let mut own: Vec<[usize; 2]> = Vec::new();
    for (entry, end) in spans(all, usize::MAX) {
        match (entry.key.as_str(), &entry.value.kind) {
            ("values" | "lengths", Kind::Object(entries)) => {
                own.extend(spans(entries, end).map(|(entry, end)| [entry.at, end]));
            }
            ("points", Kind::Object(figures)) => {
                for (figure, end) in spans(figures, end) {
                    if let Kind::Object(points) = &figure.value.kind {
                        own.extend(spans(points, end).map(|(entry, end)| [entry.at, end]));
                    }
                }
            }
            _ => {}
        }
    }
    // A key that is given twice in one answer leaves that one open; elsewhere nobody knows what is meant.
    let within = |fault: &&Fault| own.iter().any(|[from, to]| (*from..*to).contains(&fault.at));
    if let Some(fault) = twice.iter().find(|fault| !within(fault)) {
        return Err(fault.clone());
    }
    let scales = Scales::read(None, Some(&scene.units))?;
    let mut reader = Reader { answers, scales, units_lost: false, scene, twice };
    for (key, fault) in fields.unknown() {
        reader.answers.miss(key, None, fault);
    }
    reader.heads(&fields);
    let end_of = |key: &str| {
        spans(all, usize::MAX).find(|(entry, _)| entry.key == key).map_or(usize::MAX, |(_, end)| end)
    };
    reader.values(&fields, end_of("values"))?;
    reader.stated_scales(&fields);
    reader.lengths(&fields, end_of("lengths"))?;
    reader.points(&fields, end_of("points"))?;
    reader.tolerances(&fields);
    let mut answers = reader.answers;
    answers.void_what_is_written_twice();
    answers.take_plus_for_a_sense();
    Ok(answers)
}

/// A file of answers while it is read, field by field.
struct Reader<'r> {
    answers: Answers,
    scales: Scales,
    /// What the file says of its units is not understood: only numbers with a unit of their own tell something.
    units_lost: bool,
    scene: &'r Scene,
    /// Keys that are given twice.
    twice: &'r [Fault],
}

/// Of what was measured on a drawing whose scale is not understood.
const WITHOUT_SCALE: &str = "the scale that is stated for it cannot be used";

impl Reader<'_> {
    /// Whose answers these are, and in which units.
    fn heads(&mut self, fields: &Fields<'_, '_>) {
        let mut text = |key: &str, what: &str| {
            let read = fields.get(key).map(|value| value.text(what).map(str::to_owned)).transpose();
            self.answers.grasp(key, None, read).flatten()
        };
        text("$schema", "the address of the schema");
        let student = text("student", "a name, as text");
        text("variant", "the number of a variant, as text");
        let drawing = text("drawing", "the name of an SVG file");
        self.answers.student = student;
        self.answers.drawing = drawing;
        self.answers.drawing_at = fields.get("drawing").map_or(0, |value| value.at);
        let units = Scales::read(fields.get("units"), Some(&self.scene.units));
        match self.answers.grasp("units", None, units) {
            Some(scales) => self.scales = scales,
            None => self.units_lost = true,
        }
    }

    /// Refuses what is given twice within one field.
    fn once(&self, entry: &Entry<'_>, end: usize) -> Res<()> {
        let mut twice = self.twice.iter();
        let inside = twice.find(|fault| entry.at < fault.at && fault.at < end);
        inside.map_or(Ok(()), |fault| Err(fault.clone()))
    }

    /// The entries of a key; none where it is no object, which is noted.
    fn entries<'v, 'a>(&mut self, fields: &Fields<'v, 'a>, key: &str, what: &str) -> &'v [Entry<'a>] {
        self.answers.grasp(key, None, entries(fields, key, what)).unwrap_or(&[])
    }

    fn values(&mut self, fields: &Fields<'_, '_>, end: usize) -> Res<()> {
        let entries = self.entries(fields, "values", "values, by name of the quantity");
        let names = Names::new(&self.scene.mechanism, &self.scales);
        for (entry, end) in spans(entries, end) {
            self.answers.count(entry.at)?;
            let asked = quantity(&names, &entry.key, entry.at, self.scene);
            let Some(asked) = self.answers.grasp(&entry.key, None, asked) else { continue };
            let (of, measure) = (asked.quantity, asked.quantity.measure());
            // A box that was left empty: not answered.
            if is_blank(&entry.value) {
                continue;
            }
            let read = self.once(entry, end).and_then(|()| refuse_commas(&entry.value));
            let read = read.and_then(|()| match self.units_lost {
                true => refuse_bare(&entry.value, measure),
                false => Ok(()),
            });
            let item = read.and_then(|()| value(asked, entry, &self.scales));
            let item = self.answers.grasp(&entry.key, Some(of), item);
            self.answers.items.extend(item.flatten());
        }
        Ok(())
    }

    fn stated_scales(&mut self, fields: &Fields<'_, '_>) {
        let Some(value) = fields.get("scales") else { return };
        let stated = Fields::among(value, SCALES, "scales by diagram");
        let Some(stated) = self.answers.grasp("scales", None, stated) else {
            self.answers.lost_scales = SCALES.to_vec();
            return;
        };
        // Whoever states a scale for something else may have meant any that he does not state.
        for (key, fault) in stated.unknown() {
            self.answers.miss(&format!("scales.{key}"), None, fault);
            self.answers.lost_scales =
                SCALES.iter().copied().filter(|key| stated.get(key).is_none()).collect();
        }
        for (key, measure) in [
            ("length", Measure::Length),
            ("velocity", Measure::Velocity),
            ("acceleration", Measure::Acceleration),
            ("force", Measure::Force),
        ] {
            let Some(value) = stated.get(key) else { continue };
            let bare = || if self.units_lost { refuse_bare(value, measure) } else { Ok(()) };
            let read = refuse_commas(value).and_then(|()| bare());
            let read = read.and_then(|()| drawing_scale(value, measure, &self.scales));
            let Some(scale) = self.answers.grasp(&format!("scales.{key}"), None, read) else {
                self.answers.lost_scales.push(key);
                continue;
            };
            // From metres of paper to millimetres.
            let scale = Some(scale / 1000.0);
            match Dimension::ALL.into_iter().find(|dimension| scale_of_dimension(*dimension) == key) {
                Some(dimension) => {
                    self.answers.scales.0[dimension as usize] = scale;
                    self.answers.scales_at[dimension as usize] = value.at;
                }
                None => self.answers.scales.1 = scale,
            }
        }
    }

    fn lengths(&mut self, fields: &Fields<'_, '_>, end: usize) -> Res<()> {
        let what = "lengths on the drawing in mm, by name of the quantity";
        let entries = self.entries(fields, "lengths", what);
        let names = Names::new(&self.scene.mechanism, &self.scales);
        for (entry, end) in spans(entries, end) {
            self.answers.count(entry.at)?;
            let asked = quantity(&names, &entry.key, entry.at, self.scene);
            let Some(asked) = self.answers.grasp(&entry.key, None, asked) else { continue };
            if is_blank(&entry.value) {
                continue;
            }
            let of = asked.quantity;
            let scale = match of {
                Quantity::Force(..) => "force",
                _ => scale_of(of.order()),
            };
            let read = self.once(entry, end).and_then(|()| refuse_commas(&entry.value));
            let read = read.and_then(|()| match self.answers.lost_scales.contains(&scale) {
                true => Err(Fault::new(entry.at, WITHOUT_SCALE)),
                false => Ok(()),
            });
            let item = read.and_then(|()| {
                let (mm, rounding) = plain(&entry.value, "a length in mm")?;
                drawn(asked, mm, rounding, entry.at)
            });
            let item = self.answers.grasp(&entry.key, Some(of), item);
            self.answers.items.extend(item);
        }
        Ok(())
    }

    fn points(&mut self, fields: &Fields<'_, '_>, end: usize) -> Res<()> {
        let figures = |key: &str, what: &str| {
            fields.get(key).map(|value| Fields::among(value, FIGURES, what)).transpose()
        };
        let scans = figures("scan", "reference points by figure");
        let unread_scan = scans.is_err();
        let scans = self.answers.grasp("scan", None, scans).flatten();
        let points = figures("points", "points by figure");
        let points = self.answers.grasp("points", None, points).flatten();
        for (key, of) in [("scan", scans), ("points", points)] {
            for (name, fault) in of.into_iter().flat_map(Fields::unknown) {
                self.answers.miss(&format!("{key}.{name}"), None, fault);
            }
        }
        let all = fields.get("points").and_then(|value| value.object("").ok()).unwrap_or(&[]);
        for (entry, end) in spans(all, end) {
            let Some(order) = order_of(&entry.key) else { continue };
            let scan = scans.and_then(|scans| scans.get(&entry.key)).map(scan).transpose();
            let lost = match (&scan, unread_scan) {
                (Err(_), _) | (_, true) => Err("the reference points of its scan are not understood"),
                _ if self.answers.lost_scales.contains(&scale_of(order)) => Err(WITHOUT_SCALE),
                _ => Ok(()),
            };
            let scan = self.answers.grasp(&format!("scan.{}", entry.key), None, scan).flatten();
            let lost = lost.map_err(|why| Fault::new(entry.at, why));
            let figure = format!("points.{}", entry.key);
            if self.answers.grasp(&figure, None, lost).is_some() {
                self.figure((order, figure), entry, scan, end)?;
            }
        }
        for entry in fields.get("scan").and_then(|value| value.object("").ok()).unwrap_or(&[]) {
            let given = all.iter().any(|figure| figure.key == entry.key);
            if order_of(&entry.key).is_some() && !given {
                let key = &entry.key;
                let fault = Fault::new(entry.at, format!("no points of the {key} figure are given"));
                let fault = fault.mend(format!("give them in `points.{key}`, in pixels"));
                self.answers.miss(&format!("scan.{key}"), None, fault);
            }
        }
        Ok(())
    }

    /// The points of one figure.
    fn figure(
        &mut self,
        (order, name): (Order, String),
        figure: &Entry<'_>,
        scan: Option<Scan>,
        end: usize,
    ) -> Res<()> {
        let points = figure.value.object("points in mm, by their names");
        let Some(points) = self.answers.grasp(&name, None, points) else { return Ok(()) };
        self.answers.figures.push(FigurePoints { order, points: Vec::new(), shared: Vec::new() });
        for (entry, end) in spans(points, end) {
            self.answers.count(entry.at)?;
            let read = self.once(entry, end).and_then(|()| refuse_commas(&entry.value));
            let place = read.and_then(|()| pair(&entry.value, "a point [x, y]")).and_then(|place| {
                let place = scan.map_or(place, |scan| scan.to_paper(place));
                on_paper(place[0], entry.value.at)?;
                on_paper(place[1], entry.value.at)?;
                Ok(place)
            });
            let place = self.answers.grasp(&format!("{}:{}", figure.key, entry.key), None, place);
            if let (Some(place), Some(figure)) = (place, self.answers.figures.last_mut()) {
                figure.points.push((entry.key.clone(), place, entry.at));
            }
        }
        Ok(())
    }

    /// `tolerance`: the hand, or a tolerance by name.
    fn tolerances(&mut self, fields: &Fields<'_, '_>) {
        let entries = self.entries(fields, "tolerance", "tolerances, by name");
        let names = Names::new(&self.scene.mechanism, &self.scales);
        for entry in entries {
            let read = refuse_commas(&entry.value);
            let read = read.and_then(|()| tolerance(entry, &names, &self.scales, &mut self.answers));
            self.answers.grasp(&format!("tolerance.{}", entry.key), None, read);
        }
    }
}

/// A figure's scale, as reports name it.
pub(super) fn scale_name(order: Order) -> String {
    format!("scales.{}", scale_of(order))
}

/// The scale that a file states for a figure.
fn scale_of(order: Order) -> &'static str {
    scale_of_dimension(order.dimension())
}

fn scale_of_dimension(dimension: Dimension) -> &'static str {
    match dimension {
        Dimension::Length => "length",
        Dimension::Velocity => "velocity",
        Dimension::Acceleration => "acceleration",
    }
}

fn entries<'v, 'a>(fields: &Fields<'v, 'a>, key: &str, what: &str) -> Res<&'v [Entry<'a>]> {
    fields.get(key).map_or(Ok(&[]), |value| value.object(what))
}

/// Whether nothing was written.
pub(super) fn is_blank(value: &Value<'_>) -> bool {
    match &value.kind {
        Kind::Null => true,
        Kind::Text(text) => text.trim().is_empty(),
        _ => false,
    }
}

/// A quantity by its name in scenes, or one that is asked as the sheet prints it: `V_B`, `v_B`, `ω₃`, `omega3`.
pub(super) fn quantity(names: &Names<'_>, name: &str, at: usize, scene: &Scene) -> Res<Asked> {
    names.quantity(name, at).or_else(|fault| {
        let wanted = letters(name);
        let mut meant: Vec<&Asked> = Vec::new();
        for asked in &scene.mechanism.asked {
            let symbol = letters(&crate::sheet::symbol(scene, asked.quantity).plain);
            if symbol == wanted && meant.iter().all(|known| known.quantity != asked.quantity) {
                meant.push(asked);
            }
        }
        match meant[..] {
            [one] => names.quantity(&one.name, at),
            _ => Err(fault),
        }
    })
}

/// The letters and digits of a symbol, however its indices and Greek letters are written.
fn letters(symbol: &str) -> String {
    let mut plain = String::new();
    for letter in symbol.chars() {
        match letter {
            'ω' | 'Ω' => plain.push_str("omega"),
            'α' | 'ε' => plain.push_str("alpha"),
            '₀'..='₉' => plain.extend(char::from_digit(letter as u32 - '₀' as u32, 10)),
            'ⁿ' => plain.push('n'),
            'ᵗ' => plain.push('t'),
            'ᶜ' => plain.push('c'),
            letter if letter.is_alphanumeric() => plain.extend(letter.to_lowercase()),
            _ => {}
        }
    }
    plain.replace("epsilon", "alpha")
}

/// One entry of `values`; nothing where its boxes were left empty.
fn value(asked: Asked, entry: &Entry<'_>, scales: &Scales) -> Res<Option<Item>> {
    // As sheets and reports print it: "1.049 m/s at 270°", "1.049 m/s ∠ 270°".
    if let Kind::Text(text) = &entry.value.kind
        && is_vector(&asked.quantity)
        && let Some((size, angle)) = text.split_once(" at ").or_else(|| text.split_once('∠'))
    {
        let part = |text: String| Value { at: entry.value.at, kind: Kind::Text(text) };
        let angle = scales.given(&part(angle.replace('°', " deg")), Measure::Angle)?.value;
        let item = scalar(asked, &part(with_plain_unit(size.trim()).into_owned()), None, entry.at, scales)?;
        return directed(item, angle).map(Some);
    }
    match &entry.value.kind {
        Kind::List(_) => components(asked, &entry.value, None, entry.at, scales).map(Some),
        Kind::Object(all) => {
            let expected = "a value, such as {\"magnitude\": \"1.2 m/s\", \"direction\": \"37 deg\"}";
            let fields = Fields::of(&entry.value, VALUE, expected)?;
            if !all.is_empty() && all.iter().all(|entry| is_blank(&entry.value) || entry.key == "unit") {
                return Ok(None);
            }
            let written = |key: &str| fields.get(key).filter(|value| !is_blank(value));
            let unit = written("unit").map(|unit| -> Res<Scale> {
                let symbol = unit.text("the name of a unit")?;
                Scale::parse(symbol, unit.at)?.must_be(asked.quantity.measure(), unit.at)
            });
            let unit = unit.transpose()?;
            if let Some(list) = written("components") {
                fields
                    .refuse(&["value", "magnitude", "direction", "sense"], "the components say everything")?;
                let item = components(asked, list, unit, entry.at, scales)?;
                return through(item, written("through"), scales).map(Some);
            }
            let size = match (written("value"), written("magnitude")) {
                (Some(value), None) => value,
                (None, Some(value)) => value,
                (Some(_), Some(magnitude)) => {
                    return Err(Fault::new(magnitude.at, "`value` and `magnitude` say the same: keep one"));
                }
                (None, None) => return Err(Fault::new(entry.at, "`magnitude` or `components` is missing")),
            };
            let sense = written("sense").map(|sense| match sense.text("cw or ccw")? {
                "cw" => Ok(-1.0),
                "ccw" => Ok(1.0),
                other => {
                    Err(Fault::new(sense.at, format!("`{other}` is no sense")).known(other, ["cw", "ccw"]))
                }
            });
            let sense = sense.transpose()?;
            let direction =
                written("direction").map(|d| scales.given(d, Measure::Angle).map(|g| g.value)).transpose()?;
            let mut item = scalar(asked, size, unit, entry.at, scales)?;
            if let (Given::Signed(value), true) = (item.given, written("magnitude").is_some())
                && value < 0.0
            {
                let fault = Fault::new(size.at, "a magnitude is not negative");
                return Err(fault.mend("say its `sense`, cw or ccw, or give a `value` with its sign"));
            }
            if let Some(sense) = sense {
                item.given = turned(&item, sense)?;
            }
            let item = match direction {
                Some(angle) => directed(item, angle)?,
                None => item,
            };
            through(item, written("through"), scales).map(Some)
        }
        _ => scalar(asked, &entry.value, None, entry.at, scales).map(Some),
    }
}

/// A force with a point of its line.
fn through(item: Item, place: Option<&Value<'_>>, scales: &Scales) -> Res<Item> {
    let Some(place) = place else { return Ok(item) };
    if !matches!(item.asked.quantity, Quantity::Force(Force::Vector(_), _)) {
        let fault = Fault::new(place.at, format!("`{}` is no force that has a line", item.asked.name));
        return Err(fault.mend("leave out `through`"));
    }
    match place.list("a point [x, y] of the line of the force")? {
        [x, y] => {
            let [x, y] = [scales.given(x, Measure::Length)?.value, scales.given(y, Measure::Length)?.value];
            Ok(Item { through: Some([x, y]), ..item })
        }
        other => Err(Fault::new(place.at, format!("expected a point [x, y], found {} numbers", other.len()))),
    }
}

/// A magnitude with a sense of rotation.
pub(super) fn turned(item: &Item, sense: f64) -> Res<Given> {
    match item.given {
        Given::Magnitude(size) if item.asked.quantity.measure().turns() => Ok(Given::Signed(sense * size)),
        Given::Signed(_) if item.asked.quantity.measure().turns() => {
            let fault = Fault::new(item.at, format!("`{}` has its sense already", item.asked.name));
            Err(fault.mend("keep one of the two: `cw`, `ccw` or the sign"))
        }
        _ => Err(Fault::new(item.at, format!("`{}` has no sense of rotation", item.asked.name))
            .mend("say its direction instead, ccw from +x")),
    }
}

/// A magnitude with a direction, ccw from +x.
pub(super) fn directed(item: Item, angle: f64) -> Res<Item> {
    match item.given {
        Given::Magnitude(size) if is_vector(&item.asked.quantity) => {
            let given = Given::Vector([size * libm::cos(angle), size * libm::sin(angle)]);
            Ok(Item { given, form: Form::Polar, ..item })
        }
        _ => Err(Fault::new(item.at, format!("`{}` has no direction", item.asked.name))),
    }
}

/// A number with or without sense.
pub(super) fn scalar(
    asked: Asked,
    value: &Value<'_>,
    unit: Option<Scale>,
    at: usize,
    scales: &Scales,
) -> Res<Item> {
    let quantity = asked.quantity;
    let default = unit.unwrap_or_else(|| default_scale(&quantity, scales));
    let stated = scales.stated(value, quantity.measure(), quantity.measure().turns(), &default)?;
    let si = stated.given.value;
    let given = match quantity {
        Quantity::Position(_) | Quantity::Centre(..) => {
            let fault = Fault::new(value.at, format!("`{}` is a place", asked.name));
            return Err(fault.mend("write both coordinates: [x, y], in a table the columns `x` and `y`"));
        }
        Quantity::Ratio(..) | Quantity::Advantage(..) => Given::Signed(si),
        // Energy is counted from angle 0 and has a sign.
        Quantity::Cycle(
            CycleQuantity::Highest | CycleQuantity::Lowest | CycleQuantity::Area(_) | CycleQuantity::Level(_),
        ) => Given::Signed(si),
        _ if is_vector(&quantity) && si < 0.0 => {
            let fault = Fault::new(value.at, format!("the magnitude of `{}` is not negative", asked.name));
            return Err(fault.mend("give its `direction`, ccw from +x, or both components [x, y]"));
        }
        _ if never_negative(&quantity) && si < 0.0 => {
            return Err(Fault::new(value.at, format!("`{}` is never negative", asked.name)));
        }
        _ if stated.sense.is_some_and(|sense| (sense == Sense::Ccw) == (si < 0.0)) && si != 0.0 => {
            let fault = Fault::new(value.at, format!("`{}` has a sign and a sense", asked.name));
            return Err(fault.mend("keep one of the two: `cw`, `ccw` or the sign"));
        }
        _ if stated.sense.is_some() || si < 0.0 => Given::Signed(si),
        _ => Given::Magnitude(si),
    };
    let unit = stated.scale.unit();
    let rounding = last_place(value) / 2.0 * unit.si;
    let minus = si < 0.0 && (is_rate(&quantity) || is_torque(&quantity));
    let asked = Asked { unit, ..asked };
    Ok(Item { asked, given, form: Form::Number, minus, through: None, rounding, at })
}

/// A list of two components.
fn components(asked: Asked, list: &Value<'_>, unit: Option<Scale>, at: usize, scales: &Scales) -> Res<Item> {
    let parts = list.list("two components [x, y]")?;
    let [x, y] = parts else {
        return Err(Fault::new(list.at, format!("expected two components [x, y], found {}", parts.len())));
    };
    vector(asked, [x, y], unit, at, scales)
}

/// Two components.
pub(super) fn vector(
    asked: Asked,
    [x, y]: [&Value<'_>; 2],
    unit: Option<Scale>,
    at: usize,
    scales: &Scales,
) -> Res<Item> {
    if !is_vector(&asked.quantity) {
        return Err(Fault::new(at, format!("`{}` is a number, not a vector", asked.name)));
    }
    let default = unit.unwrap_or_else(|| default_scale(&asked.quantity, scales));
    let stated = |value: &Value<'_>| scales.stated(value, asked.quantity.measure(), false, &default);
    let [a, b] = [stated(x)?, stated(y)?];
    let unit: Unit = a.scale.unit();
    let rounding = last_place(x).max(last_place(y)) / 2.0 * unit.si;
    let given = Given::Vector([a.given.value, b.given.value]);
    let asked = Asked { unit, ..asked };
    Ok(Item { asked, given, form: Form::Components, minus: false, through: None, rounding, at })
}

/// A length measured on the drawing.
pub(super) fn drawn(asked: Asked, mm: f64, rounding: f64, at: usize) -> Res<Item> {
    if !is_vector(&asked.quantity) || matches!(asked.quantity, Quantity::Position(_) | Quantity::Centre(..)) {
        let fault = Fault::new(at, format!("`{}` is no vector of a polygon", asked.name));
        return Err(fault.mend("give its value in `values`"));
    }
    if mm < 0.0 {
        return Err(Fault::new(at, "a length on the drawing is not negative"));
    }
    on_paper(mm, at)?;
    let given = Given::Drawn(mm);
    Ok(Item { asked, given, form: Form::Paper, minus: false, through: None, rounding, at })
}

/// A tolerance beyond it says nothing.
const MOST_PERCENT: f64 = 1000.0;

/// Refuses a coordinate or length (mm) that no paper has.
pub(super) fn on_paper(mm: f64, at: usize) -> Res<()> {
    if mm.abs() <= limits::PAPER_MM {
        return Ok(());
    }
    let fault = Fault::new(at, format!("{mm:e} mm is on no paper"));
    Err(fault.mend(format!("lengths and coordinates on paper are {} mm at most", limits::PAPER_MM)))
}

/// A number without unit, and half a unit in its last place.
fn plain(value: &Value<'_>, expected: &str) -> Res<(f64, f64)> {
    let digits = match &value.kind {
        Kind::Number(digits) => digits,
        Kind::Text(text) => match Words::split(text) {
            Some(Words { digits, unit: "" | "mm", sense: None }) => digits,
            _ => return Err(value.unexpected(expected)),
        },
        _ => return Err(value.unexpected(expected)),
    };
    Ok((number(digits, value.at)?.value, last_place(value) / 2.0))
}

/// One unit in the last place of a number as written.
fn last_place(value: &Value<'_>) -> f64 {
    let digits = match &value.kind {
        Kind::Number(digits) => digits,
        Kind::Text(text) => Words::split(text).map_or("", |words| words.digits),
        _ => "",
    };
    let (mantissa, exponent) = digits.split_once(['e', 'E']).unwrap_or((digits, "0"));
    let decimals = mantissa.split_once('.').map_or(0, |(_, decimals)| decimals.len());
    let power = exponent.parse::<f64>().unwrap_or(0.0) - f64::from(u32::try_from(decimals).unwrap_or(0));
    libm::pow(10.0, power)
}

/// Whether a quantity has two components.
#[must_use]
pub(super) fn is_vector(quantity: &Quantity) -> bool {
    matches!(quantity.nature(), Nature::Vector | Nature::Place)
}

/// Whether a number is an angular velocity or acceleration.
fn is_rate(quantity: &Quantity) -> bool {
    matches!(quantity.measure(), Measure::AngularVelocity | Measure::AngularAcceleration)
}

fn is_torque(quantity: &Quantity) -> bool {
    quantity.measure() == Measure::Torque && quantity.measure().turns()
}

/// Whether a number carries neither sign nor sense.
fn never_negative(quantity: &Quantity) -> bool {
    quantity.nature() == Nature::Size
}

/// The figure of a key.
pub(super) fn order_of(key: &str) -> Option<Order> {
    match key {
        "velocity" => Some(Order::Velocity),
        "acceleration" => Some(Order::Acceleration),
        "skeleton" => Some(Order::Position),
        _ => None,
    }
}

fn pair(value: &Value<'_>, expected: &str) -> Res<[f64; 2]> {
    match value.list(expected)? {
        [x, y] => Ok([plain(x, "a coordinate")?.0, plain(y, "a coordinate")?.0]),
        other => Err(Fault::new(value.at, format!("expected {expected}, found {} numbers", other.len()))),
    }
}

fn scan(value: &Value<'_>) -> Res<Scan> {
    let fields = Fields::of(value, SCAN, "two reference points in pixels and in mm")?;
    let two = |key: &str| -> Res<[[f64; 2]; 2]> {
        let list = fields.need(key, "two reference points tell scale and rotation of a scan")?;
        match list.list("two points [[x, y], [x, y]]")? {
            [a, b] => Ok([pair(a, "a point [x, y]")?, pair(b, "a point [x, y]")?]),
            other => Err(Fault::new(list.at, format!("expected two points, found {}", other.len()))),
        }
    };
    Scan::new(two("pixels")?, two("mm")?).ok_or_else(|| {
        Fault::new(value.at, "the two reference points are one").mend("take two points far apart")
    })
}

/// One entry of `tolerance`: the hand, or a tolerance by name.
fn tolerance(
    Entry { at, key, value }: &Entry<'_>,
    names: &Names<'_>,
    scales: &Scales,
    answers: &mut Answers,
) -> Res<()> {
    match key.as_str() {
        "length" => {
            let text = matches!(value.kind, Kind::Text(_));
            let mm = if text {
                scales.given(value, Measure::Length)?.value * 1000.0
            } else {
                plain(value, "mm")?.0
            };
            answers.hand.0 = Some(bounded(mm, 10.0, value.at, "mm")?);
        }
        "angle" => {
            let angle = scales.given(value, Measure::Angle)?.value;
            answers.hand.1 = Some(bounded(angle.to_degrees(), 10.0, value.at, "deg")?.to_radians());
        }
        name => {
            let asked = names.quantity(name, *at)?;
            let percent = match &value.kind {
                Kind::Text(text) => Words::split(text).filter(|w| w.unit == "%"),
                _ => None,
            };
            let tolerance = match percent {
                Some(words) => {
                    let percent = number(words.digits, value.at)?.value;
                    if percent > MOST_PERCENT {
                        let what = format!("a tolerance of more than {MOST_PERCENT} %");
                        return Err(Fault::new(value.at, what));
                    }
                    Tolerance::Part(percent / 100.0)
                }
                None => {
                    let default = default_scale(&asked.quantity, scales);
                    let stated = scales.stated(value, asked.quantity.measure(), false, &default)?;
                    Tolerance::Amount(stated.given.value)
                }
            };
            let (Tolerance::Part(size) | Tolerance::Amount(size)) = tolerance;
            if size.is_nan() || size <= 0.0 {
                return Err(Fault::new(value.at, "a tolerance is greater than zero"));
            }
            answers.tolerances.push((asked.name, tolerance));
        }
    }
    Ok(())
}

fn bounded(value: f64, most: f64, at: usize, unit: &str) -> Res<f64> {
    if (0.0..=most).contains(&value) {
        return Ok(value);
    }
    Err(Fault::new(at, format!("a hand slips by 0 to {most} {unit}")))
}
