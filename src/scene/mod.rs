//! The scene file: types, units, schema, and diagnostics with line, column, path and mend.
//!
//! **Architecture Invariant:** nothing here solves or draws; the scene is lowered to a
//! [`Mechanism`] in SI units and this room is left.

pub(crate) mod asked;
mod cycle;
pub(crate) mod diagnostic;
mod draft;
mod figure;
mod force_names;
mod forces;
mod friction;
mod guides;
mod inputs;
pub(crate) mod json;
mod keys;
mod links;
mod placing;
mod published;
mod rolls;
mod schema;
mod sheet;
mod source;
mod spin;
#[cfg(test)]
mod tests;
mod twice;
pub(crate) mod units;
mod vary;
mod written;

pub use asked::names_of_quantities;
pub use diagnostic::{Diagnostic, nearest};
pub use schema::schema;
pub use sheet::{input_place, paper_size};
pub use source::{Source, Subject};
pub use units::si_of;
pub use written::Written;

/// The unit of this scene in which a quantity is told where nobody says in which.
pub(crate) fn unit_of(quantity: &Quantity, scene: &Scene) -> Unit {
    use units::Measure;
    let Units { length, angle, time, .. } = &scene.units;
    let per = |symbol: &str, si: f64, squared: bool| {
        let (power, times) = if squared { ("^2", time.si * time.si) } else { ("", time.si) };
        Unit { symbol: format!("{symbol}/{}{power}", time.symbol), si: si / times }
    };
    match quantity.measure() {
        Measure::Length => length.clone(),
        Measure::Angle => angle.clone(),
        Measure::Velocity => per(&length.symbol, length.si, false),
        Measure::Acceleration => per(&length.symbol, length.si, true),
        Measure::AngularVelocity => per("rad", 1.0, false),
        Measure::AngularAcceleration => per("rad", 1.0, true),
        Measure::Number => Unit { symbol: String::new(), si: 1.0 },
        Measure::Force => scene.units.force.clone(),
        Measure::Torque => scene.units.torque.clone(),
        Measure::Mass => scene.units.mass.clone(),
        Measure::Inertia => scene.units.inertia.clone(),
        Measure::Stiffness => scene.units.stiffness.clone(),
        Measure::Pressure => scene.units.pressure.clone(),
        Measure::Power => scene.units.power.clone(),
        Measure::TurningStiffness => Unit { symbol: "N*m/rad".to_owned(), si: 1.0 },
        Measure::Area => Unit { symbol: "m^2".to_owned(), si: 1.0 },
    }
}

pub use vary::{Range, Varied, asking_less, variant};

use crate::mechanism::quantity::{Quantity, Unit};
use crate::mechanism::{Mechanism, PointId};
use diagnostic::{Fault, Res};
use draft::Draft;
use json::{Fields, Value};

/// Reads a scene. `file` is only named in diagnostics.
///
/// ```
/// let text = r#"{
///   "units": { "length": "cm" },
///   "fixed": { "O2": [0, 0] },
///   "links": {
///     "2": { "joins": ["O2", "A"], "length": 15 },
///     "3": { "joins": ["A", "B"], "length": 45 }
///   },
///   "slides": [ { "pin": "B", "block": 4, "on": { "link": 1, "through": "O2" } } ],
///   "near":   { "B": [50, 0] },
///   "input":  { "link": 2, "angle": 30, "omega": "10 rad/s cw" },
///   "find":   ["v(B)"]
/// }"#;
/// let scene = linkgram::scene::read(text, "slider.json")?;
/// assert_eq!(scene.mechanism.links.len(), 4);
///
/// let error = linkgram::scene::read(&text.replace("length\": 45", "lenght\": 45"), "slider.json").unwrap_err();
/// assert_eq!(
///     error.to_string(),
///     "slider.json:6:33: links.3.lenght: unknown key `lenght`; help: did you mean `length`?",
/// );
/// # Ok::<(), linkgram::scene::Diagnostic>(())
/// ```
///
/// # Errors
///
/// The first and most fundamental thing that is wrong with the text, with its place and its mend.
/// Whether the mechanism moves as it should, and whether it can be assembled, is not known here.
pub fn read(text: &str, file: &str) -> Result<Scene, Diagnostic> {
    let document = json::parse(text).map_err(|fault| fault.locate(file, text, None))?;
    let (root, fault) = document.strictly();
    let scene = fault.map_or_else(|| scene(&root, text, file), Err);
    scene.map_err(|fault| fault.locate(file, text, Some(&root)))
}

fn scene(root: &Value<'_>, text: &str, file: &str) -> Res<Scene> {
    let fields = Fields::of(root, keys::SCENE, "a scene: {\"links\": {…}, \"input\": {…}, …}")?;
    fields.get("$schema").map(|address| address.text("the address of the schema")).transpose()?;
    let title = sheet::title(fields.get("title"))?;
    let scales = units::Scales::read(fields.get("units"), None)?;
    let mut draft = Draft::new(&scales, root.at);
    links::read(&fields, &mut draft)?;
    forces::spots(&fields, &mut draft)?;
    let diagram_alone = cycle::is_alone(&fields, &draft);
    if draft.mechanism.moving().next().is_none() && !diagram_alone {
        return Err(Fault::new(root.at, "nothing moves: the scene has no links")
            .mend("list them in `links`; `linkgram new four-bar` writes a ready scene"));
    }
    guides::slides(fields.get("slides"), &mut draft)?;
    rolls::read(fields.get("rolls"), &mut draft)?;
    if !diagram_alone {
        inputs::read(&fields, &mut draft)?;
    }
    placing::along_by_places(&mut draft)?;
    placing::settle(&mut draft)?;
    figure::read(&fields, &mut draft)?;
    placing::directed_by_places(&mut draft);
    forces::read(&fields, &mut draft)?;
    cycle::read(&fields, &mut draft)?;
    twice::settle(&mut draft)?;
    asked::read(fields.get("find"), &mut draft)?;
    spin::refuse_rates(fields.get("find"), &draft)?;
    let published = published::read(fields.get("published"), &mut draft)?;
    let errata = published::errata(fields.get("errata"), &published)?;
    let expect = published::expect(fields.get("expect"))?;
    draft.anchors.sheet = fields.get("sheet").map(|value| value.at);
    let sheet = sheet::read(fields.get("sheet"), &scales, &draft.mechanism)?;
    draft.anchors.vary = fields.get("vary").map(|value| value.at);
    let vary = vary::read(root, fields.get("vary"))?;
    let written = Written::read(root, &scales);
    let source = Source { file: file.to_owned(), text: text.to_owned(), anchors: draft.anchors };
    let mut mechanism = draft.mechanism;
    rolls::name_contacts(&mut mechanism);
    let (input_units, spin_unit, gears) = (draft.input_units, draft.spin_unit, draft.gears);
    Ok(Scene {
        title,
        units: scales.units(),
        mechanism,
        published,
        errata,
        expect,
        input_units,
        gears,
        written,
        spin_unit,
        sheet,
        vary,
        source,
    })
}

/// A scene: the mechanism in SI units and what the file says about asking, publishing and drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// Title by language; empty where the file has none.
    pub title: Title,
    /// The units of bare numbers, in which answers are given.
    pub units: Units,
    /// The mechanism.
    pub mechanism: Mechanism,
    /// What somebody printed, in the order of the file.
    pub published: Vec<Published>,
    /// Names in `published` that are known to be wrong.
    pub errata: Vec<String>,
    /// The refusal that this scene must get.
    pub expect: Option<Refusal>,
    /// How the motion of each input is stated, by index of the input.
    pub input_units: Vec<InputUnits>,
    /// The teeth of each rolling pair, where they stand for its radii; by index of the pair.
    pub gears: Vec<Option<Gears>>,
    /// In which units numbers are written.
    pub written: Written,
    /// The unit in which the speed of a governor is stated, where it is.
    pub spin_unit: Option<Unit>,
    /// How to draw.
    pub sheet: SheetOptions,
    /// What exam variants may change, in the order of the file; never looked at in a solution.
    pub vary: Vec<Varied>,
    /// Where everything stands in the file.
    pub source: Source,
}

/// Teeth that stand for radii, as the scene states them.
#[derive(Debug, Clone, PartialEq)]
pub struct Gears {
    /// Their numbers: of both wheels, or of the one on a rack.
    pub teeth: Vec<u32>,
    /// Pitch diameter per tooth, metres.
    pub module: f64,
}

/// A title, in one or more languages.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Title {
    /// Text without a language.
    pub plain: Option<String>,
    /// Language tag and text, in the order of the file.
    pub by_language: Vec<(String, String)>,
}

impl Title {
    /// The title in a language, else in the language of which it is a variant (`ar` for `ar-x-ajala`),
    /// else without a language, else in English, else in the first one.
    #[must_use]
    pub fn in_language(&self, language: &str) -> Option<&str> {
        let find = |tag: &str| {
            let texts = self.by_language.iter();
            texts.clone().find(|(t, _)| t.eq_ignore_ascii_case(tag)).map(|(_, text)| text.as_str())
        };
        let main = language.split('-').next().unwrap_or_default();
        find(language)
            .or_else(|| find(main))
            .or(self.plain.as_deref())
            .or_else(|| find("en"))
            .or_else(|| self.by_language.first().map(|(_, text)| text.as_str()))
    }
}

/// Units of bare numbers.
#[derive(Debug, Clone, PartialEq)]
pub struct Units {
    /// Unit of length.
    pub length: Unit,
    /// Unit of angles.
    pub angle: Unit,
    /// Unit of time.
    pub time: Unit,
    /// Unit of forces.
    pub force: Unit,
    /// Unit of masses.
    pub mass: Unit,
    /// Unit of torques, and of works.
    pub torque: Unit,
    /// Unit of moments of inertia.
    pub inertia: Unit,
    /// Unit of the stiffness of a spring.
    pub stiffness: Unit,
    /// Unit of pressures.
    pub pressure: Unit,
    /// Unit of powers.
    pub power: Unit,
}

/// How an input's motion is stated.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct InputUnits {
    /// The angle with its whole turns, radians: 210° where the mechanism has −150°.
    pub angle: Option<f64>,
    /// Of ω, of the speed of a point, of the velocity of a slide.
    pub rate: Option<Unit>,
    /// Of α, of the acceleration of a slide.
    pub second: Option<Unit>,
}

/// A published value of an asked (or askable) quantity. Vectors, and scalars without a sense, are
/// compared in magnitude.
#[derive(Debug, Clone, PartialEq)]
pub struct Published {
    /// What it is about; its unit is the one in which it was printed.
    pub asked: crate::mechanism::quantity::Asked,
    /// The printed number in SI units.
    pub value: f64,
    /// Whether the print states a sense (`cw` or `ccw`), so that the sign must agree.
    pub signed: bool,
    /// Allowed relative deviation (0.1 = 10 %), if the scene states one.
    pub within: Option<f64>,
    /// Why that deviation is allowed.
    pub why: Option<String>,
}

/// A refusal that a scene may expect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The chain does not close.
    CannotAssemble,
    /// The position determines nothing that was asked.
    Indeterminate,
    /// Two assemblies and nothing to choose by.
    Ambiguous,
    /// With friction no balance exists.
    Locked,
    /// A contact would have to pull, or the like.
    NoEquilibrium,
}

/// How to draw the sheet.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct SheetOptions {
    /// Paper size: `A0` to `A6`, `letter` or `legal`, possibly with ` portrait` or ` landscape` after it;
    /// default A4.
    pub paper: Option<String>,
    /// Language tag: `en`, `ar`, `ar-x-ajala` or `fa`.
    pub language: Option<String>,
    /// Colours: `mono`, `colour` or `dark`.
    pub theme: Option<String>,
    /// Letter for angular acceleration.
    pub angular_acceleration: Option<AngularAcceleration>,
    /// How vectors are written: `standard`, or as in a textbook: `norton`, `uicker`, `rattan`, `martin`.
    pub notation: Option<String>,
    /// Decimals stand after a comma, not after a point.
    pub decimal_comma: bool,
    /// Real length per length of paper: 10 for `1:10`.
    pub length_scale: Option<f64>,
    /// m/s per mm of paper.
    pub velocity_scale: Option<f64>,
    /// m/s² per mm of paper.
    pub acceleration_scale: Option<f64>,
    /// Newtons per mm of paper.
    pub force_scale: Option<f64>,
    /// Marks for answers in an exam, by the name of the quantity; 1 where nothing is said.
    pub marks: Vec<(String, f64)>,
    /// Figures wanted, by name; all where empty.
    pub figures: Vec<String>,
    /// Where the first input stands in the other positions that the skeleton shows dashed: rad, or m for a slide.
    pub positions: Vec<f64>,
    /// The skeleton shows the other assembly dashed.
    pub other_assembly: bool,
    /// How the live page opens.
    pub live: LiveOptions,
}

/// How the live page opens; whoever reads it may change all of it.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LiveOptions {
    /// Seconds in which the whole course plays; 6 where nothing is said.
    pub play_seconds: Option<f64>,
    /// Points whose paths are drawn.
    pub traces: Vec<PointId>,
    /// Asked quantities whose diagrams over the input are drawn: their places among those asked for.
    pub diagrams: Vec<usize>,
    /// Polygons are fitted to each position, or keep one scale over the course; where nothing is said, whichever can be read.
    pub refit: Option<bool>,
    /// The panels that are open, by the names of their figures; all where nothing is said.
    pub panels: Vec<&'static str>,
}

/// Which letter stands for angular acceleration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AngularAcceleration {
    /// α.
    Alpha,
    /// ε.
    Epsilon,
}
