//! What is to be drawn of a scene, and the figure that comes of it: `linkgram draw` as one call.

use thiserror::Error;

use crate::check::{Unconfirmed, confirm, confirm_sweep};
use crate::graphical::Scales;
use crate::graphical::construction::Construction;
use crate::mechanism::quantity::Answer;
use crate::parallel;
use crate::plan::{Auxiliary, Extent};
use crate::render::theme::Theme;
use crate::report::{diagnose, short};
use crate::scene::{Diagnostic, Scene, Subject};
use crate::sheet::{self, Figure, Language, Wished};
use crate::solve::{Settings, SolveError, Solved, governed, solve_with};

/// No sheet is wider or higher, all its pages together (mm): scales stated by mistake, and a picture that
/// no program opens.
pub(crate) const LARGEST_SHEET: f64 = 100_000.0;

/// What is larger than a sheet may be, and how that is mended.
fn too_large(scene: &Scene, what: &str) -> Diagnostic {
    let sheet = &scene.sheet;
    let scales = [sheet.length_scale, sheet.velocity_scale, sheet.acceleration_scale, sheet.force_scale];
    let (by, mend) = if scales.iter().any(Option::is_some) {
        ("at the stated scales", "choose smaller scales; where none is stated the diagrams fill their panels")
    } else {
        ("at the scales that fit the rest", "state `scales` of the sheet at which it fits")
    };
    scene.source.complain(Subject::Sheet, format!("{by} {what}"), Some(mend.to_owned()))
}

/// What is drawn of a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[cfg_attr(feature = "cli", derive(clap::ValueEnum))]
pub enum Kind {
    /// The dimensioned skeleton, what is given and what is asked
    Question,
    /// Everything
    #[default]
    Solution,
    /// One small figure per step
    Steps,
}

/// What is to be drawn; what it leaves open the scene's `sheet` says.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wish {
    /// The question, the solution, or its steps.
    pub kind: Kind,
    /// Single figures instead of the whole, by name; of a solution those that the scene wishes, where empty.
    pub figures: Vec<String>,
    /// The language; the scene's, else English.
    pub language: Option<Language>,
    /// How to solve.
    pub settings: Settings,
}

/// Why a wish has no figure.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum NoFigure {
    /// Names a figure that is not there, or wishes that exclude each other: one sentence.
    #[error("{0}")]
    Wish(String),
    /// Something in the scene's `sheet`.
    #[error(transparent)]
    Sheet(#[from] Diagnostic),
    /// The scene has no solution.
    #[error(transparent)]
    Unsolved(#[from] SolveError),
    /// The figure would show something that the independent solver does not confirm. [`Settings::unchecked`] draws it
    /// with a note.
    #[error(transparent)]
    Unconfirmed(#[from] Unconfirmed),
}

impl Kind {
    /// All kinds.
    pub const ALL: [Self; 3] = [Self::Question, Self::Solution, Self::Steps];

    /// Its name on the command line.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Question => "question",
            Self::Solution => "solution",
            Self::Steps => "steps",
        }
    }

    /// The kind of this name.
    #[must_use]
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

impl NoFigure {
    /// The error as it is told to whoever wrote the scene, with its place in the file where it has one.
    #[must_use]
    pub fn told(&self, scene: &Scene) -> String {
        match self {
            Self::Wish(what) => what.clone(),
            Self::Sheet(diagnostic) => diagnostic.to_string(),
            Self::Unsolved(error) => diagnose(scene, error).to_string(),
            Self::Unconfirmed(why) => unconfirmed(scene, why),
        }
    }
}

/// What is wrong with the name of a figure, if it is unknown.
#[must_use]
pub fn unknown_figure(name: &str) -> Option<String> {
    let known = sheet::figure_names();
    let head = sheet::figure_head(name);
    if known.contains(&head) {
        return None;
    }
    Some(unknown("figure", name, head, known))
}

/// That `name` is unknown, and what comes nearest to its `head`, the part that is looked up.
pub(crate) fn unknown(what: &str, name: &str, head: &str, known: &[&str]) -> String {
    let nearest = crate::scene::nearest(head, known);
    let mend = nearest.map_or(String::new(), |n| format!("; did you mean {n}?"));
    format!("unknown {what} {name}{mend} (known: {})", known.join(", "))
}

/// The colours that the scene wishes, or the default.
#[must_use]
pub fn theme(scene: &Scene) -> Theme {
    scene.sheet.theme.as_deref().and_then(Theme::from_name).unwrap_or_default()
}

/// The language that the scene wishes, or English.
#[must_use]
pub fn language(scene: &Scene) -> Language {
    scene.sheet.language.as_deref().and_then(Language::from_tag).unwrap_or_default()
}

/// A figure, and what is asked and not determined in the position that it shows.
#[derive(Debug, Clone)]
pub struct Drawn {
    /// The figure.
    pub figure: Figure,
    /// The asked quantities without an answer, by name, each with the reason.
    pub indeterminate: Vec<(String, String)>,
}

/// Frames of one size, and what is asked and not determined.
#[derive(Debug, Clone)]
pub struct Film {
    /// The frames in their order.
    pub frames: Vec<Figure>,
    /// See [`Drawn::indeterminate`].
    pub indeterminate: Vec<(String, String)>,
}

/// The asked quantities without an answer.
fn indeterminate(scene: &Scene, construction: &Construction) -> Vec<(String, String)> {
    let all = scene.mechanism.asked.iter().zip(&construction.answers);
    let open = all.filter_map(|(asked, reading)| match &reading.answer {
        Answer::Indeterminate(why) => Some((asked.name.clone(), why.to_string())),
        Answer::Scalar { .. } | Answer::Vector { .. } | Answer::AtInfinity { .. } => None,
    });
    open.collect()
}

/// The figure that is wished for.
///
/// # Errors
/// See [`NoFigure`].
pub fn figure(scene: &Scene, wish: &Wish) -> Result<Figure, NoFigure> {
    Ok(drawn(scene, wish)?.figure)
}

/// The same with what is asked and not determined.
///
/// # Errors
/// See [`NoFigure`].
pub fn drawn(scene: &Scene, wish: &Wish) -> Result<Drawn, NoFigure> {
    let names = wish.names(scene)?;
    match (wish.kind, &names[..]) {
        (Kind::Question, [] | ["skeleton"]) | (Kind::Steps, []) | (Kind::Solution, _) => {}
        (Kind::Question, _) => {
            let what = "--as question: the only figure that gives no answer away is skeleton";
            return Err(NoFigure::Wish(what.to_owned()));
        }
        (Kind::Steps, _) => {
            let what = "--as steps draws all figures; leave out --figure";
            return Err(NoFigure::Wish(what.to_owned()));
        }
    }
    let solved = wish.solve(scene, &names, None)?;
    let language = wish.language(scene);
    let compose = |solved: &Solved| {
        let construction = &solved.solution.construction;
        Ok::<_, NoFigure>(match (wish.kind, &names[..]) {
            (Kind::Question, []) => sheet::question(scene, construction, language),
            (Kind::Question, _) => sheet::single_of_question(scene, construction, language),
            (Kind::Steps, _) => sheet::step_by_step(scene, construction, language),
            (Kind::Solution, []) => sheet::solution(scene, construction, language),
            (Kind::Solution, names) => {
                let shown = Shown { scene, language, settings: wish.settings };
                shown.figures(construction, names)?
            }
        })
    };
    let first = Drawing::of(scene, solved, compose)?;
    let Drawing { solved, mut figure, confirmed } = on_its_paper(scene, wish.kind, first, |scales| {
        Drawing::of(scene, wish.solve(scene, &names, Some(scales))?, compose)
    })?;
    let construction = &solved.solution.construction;
    if let Err(why) = confirmed {
        figure = wish.noted(figure, why, language)?;
    }
    figure = with_what_is_missing(figure, scene, &solved, language);
    if figure.width > LARGEST_SHEET || figure.height > LARGEST_SHEET {
        let [width, height] = [figure.width, figure.height].map(|mm| short(mm / 1000.0));
        let what = format!("the sheet would be {width} m wide and {height} m high");
        return Err(too_large(scene, &what).into());
    }
    Ok(Drawn { figure, indeterminate: indeterminate(scene, construction) })
}

/// A solution, the sheet that is composed of it, and whether the independent solver confirms what that shows.
pub(crate) struct Drawing {
    pub(crate) solved: Solved,
    pub(crate) figure: Figure,
    pub(crate) confirmed: Result<(), Unconfirmed>,
}

impl Drawing {
    /// Composes the sheet while the other solver is at work. What is wrong with the wish itself is told first.
    pub(crate) fn of<E>(
        scene: &Scene,
        solved: Solved,
        compose: impl FnOnce(&Solved) -> Result<Figure, E>,
    ) -> Result<Self, E> {
        let (confirmed, figure) = parallel::both(|| confirm(scene, &solved), || compose(&solved));
        Ok(Self { figure: figure?, solved, confirmed })
    }
}

/// A sheet whose diagrams do not fit their paper, drawn again at smaller scales. What is handed out is confirmed as it was
/// drawn last, and as it was drawn before.
pub(crate) fn on_its_paper<E>(
    scene: &Scene,
    kind: Kind,
    first: Drawing,
    again: impl Fn(Scales) -> Result<Drawing, E>,
) -> Result<Drawing, E> {
    /// How often.
    const AGAIN: usize = 4;
    let mut drawing = first;
    // A question is on one page where it can be.
    let pages = (kind == Kind::Question).then_some(1);
    for _ in 0..AGAIN {
        let construction = &drawing.solved.solution.construction;
        let next = |pages| sheet::scale::outgrown(scene, construction, &drawing.figure, pages);
        let outgrown = next(None);
        let fitting = outgrown.is_none();
        let Some((dimension, scale)) = outgrown.or_else(|| pages.and_then(|most| next(Some(most)))) else {
            break;
        };
        let other = again(drawing.solved.scales.with(dimension, scale))?;
        if fitting && other.figure.pages().len() >= drawing.figure.pages().len() {
            break;
        }
        drawing = Drawing { confirmed: drawing.confirmed.and(other.confirmed), ..other };
    }
    Ok(drawing)
}

/// The steps of the solution as frames of one size.
///
/// # Errors
/// See [`NoFigure`].
pub fn film(scene: &Scene, wish: &Wish) -> Result<Film, NoFigure> {
    if wish.kind != Kind::Steps {
        return Err(NoFigure::Wish("--play plays the steps: say --as steps as well".to_owned()));
    }
    let names = wish.names(scene)?;
    if !names.is_empty() {
        return Err(NoFigure::Wish("--as steps draws all figures; leave out --figure".to_owned()));
    }
    let solved = wish.solve(scene, &names, None)?;
    let language = wish.language(scene);
    let film = || {
        let frames = sheet::film(scene, &solved.solution.construction, language).into_iter();
        frames.map(|frame| with_what_is_missing(frame, scene, &solved, language)).collect::<Vec<_>>()
    };
    let frames = match parallel::both(|| confirm(scene, &solved), film) {
        (Ok(()), film) => film,
        (Err(why), film) => {
            let noted = film.into_iter().map(|frame| wish.noted(frame, why.clone(), language));
            noted.collect::<Result<_, _>>()?
        }
    };
    Ok(Film { frames, indeterminate: indeterminate(scene, &solved.solution.construction) })
}

/// That a figure is not drawn because it is not confirmed, and what can be done.
#[must_use]
pub fn unconfirmed(scene: &Scene, why: &Unconfirmed) -> String {
    let file = scene.source.file();
    format!(
        "{file}: not confirmed, nothing is written: {why}; help: `--unchecked` draws it with a note that says so"
    )
}

/// A figure with the notes that say which links it does not show and which names it has no room for, where there are any.
pub(crate) fn with_what_is_missing(
    figure: Figure,
    scene: &Scene,
    solved: &Solved,
    language: Language,
) -> Figure {
    let figure = match &solved.left_out {
        None => figure,
        Some(left) => {
            let why = diagnose(scene, &left.why.clone().into()).what;
            sheet::left_out(figure, &left.links, &why, language)
        }
    };
    let figure = sheet::outgrown(figure, sheet::paper(scene), language);
    sheet::unnamed(figure, language)
}

impl Wish {
    /// A figure that is not confirmed, with the note that says so, where it may be drawn at all.
    fn noted(&self, figure: Figure, why: Unconfirmed, language: Language) -> Result<Figure, NoFigure> {
        if !self.settings.unchecked {
            return Err(why.into());
        }
        Ok(sheet::unconfirmed(figure, why.name(), &why.to_string(), language))
    }

    fn language(&self, scene: &Scene) -> Language {
        self.language.unwrap_or_else(|| language(scene))
    }

    /// The single figures. What the scene wishes to have drawn is a wish for the solution.
    fn names<'a>(&'a self, scene: &'a Scene) -> Result<Vec<&'a str>, NoFigure> {
        if let Some(unknown) = self.figures.iter().find_map(|name| unknown_figure(name)) {
            return Err(NoFigure::Wish(unknown));
        }
        if let Some(unknown) = scene.sheet.figures.iter().find_map(|name| unknown_figure(name)) {
            return Err(scene.source.complain(Subject::Sheet, unknown, None).into());
        }
        let of_scene = self.figures.is_empty() && self.kind == Kind::Solution;
        let names = if of_scene { &scene.sheet.figures } else { &self.figures };
        Ok(names.iter().map(String::as_str).collect())
    }

    /// Solves, with these scales, or with those of the page. Which these are is found by paging the sheet's text: who knows
    /// them already is spared that.
    fn solve(&self, scene: &Scene, names: &[&str], scales: Option<Scales>) -> Result<Solved, NoFigure> {
        let of_page = match self.kind {
            Kind::Question => sheet::scale::for_question,
            Kind::Steps => sheet::scale::for_steps,
            Kind::Solution => sheet::scale::for_scene,
        };
        let centres = names.iter().any(|name| ["centres", "circle"].contains(name));
        let extent = if centres { Extent::AllCentres } else { Extent::WholeSkeleton };
        let wanted = names.iter().filter_map(|name| sheet::auxiliary(name, scene).transpose());
        let auxiliary: Vec<Auxiliary> = wanted.collect::<Result<_, _>>().map_err(NoFigure::Wish)?;
        let choose = |scene: &Scene, extents| scales.unwrap_or_else(|| of_page(scene, extents));
        let solved = solve_with(scene, extent, &auxiliary, self.settings, choose)?;
        // Before anything is laid out: names beside a line of a million kilometres have a million places.
        let across =
            sheet::scale::largest_diagram(scene, &solved.solution.construction, self.kind == Kind::Question);
        if across > LARGEST_SHEET {
            let what = format!("a diagram would be {} m across", short(across / 1000.0));
            return Err(too_large(scene, &what).into());
        }
        Ok(solved)
    }
}

/// The figure of a governor that is of no single place.
const CONTROLLING_FORCE: &str = "controlling-force";

/// What every single figure of a wish has in common.
struct Shown<'a> {
    scene: &'a Scene,
    language: Language,
    settings: Settings,
}

impl Shown<'_> {
    /// The controlling-force diagram, which is of all places of a governor.
    fn controlling_force(&self) -> Result<Figure, NoFigure> {
        let wish = |why: &str| NoFigure::Wish(format!("figure {CONTROLLING_FORCE}: {why}"));
        let governed = governed(&self.scene.mechanism, None).map_err(|why| wish(&why))?;
        let governed = governed
            .ok_or_else(|| wish("it is of a governor whose speed is sought: `spin` with `omega` \"?\""))?;
        if !self.settings.unchecked && confirm_sweep(&governed.sweep).is_err() {
            return Err(wish("the independent solver does not confirm the speeds of its places"));
        }
        let figure = sheet::controlling_force(self.scene, &governed, self.language);
        figure.ok_or_else(|| wish("there is equilibrium at no place of its range"))
    }

    fn figures(&self, construction: &Construction, names: &[&str]) -> Result<Figure, NoFigure> {
        let wished = names.iter().map(|name| {
            Ok(match *name {
                CONTROLLING_FORCE => Wished::Drawn(Box::new(self.controlling_force()?)),
                name => Wished::Named(name),
            })
        });
        let wished: Vec<Wished<'_>> = wished.collect::<Result<_, NoFigure>>()?;
        sheet::figures(self.scene, construction, &wished, self.language).map_err(|place| {
            let name = names[place];
            let kind = sheet::auxiliary(name, self.scene).ok().flatten();
            let drawing = construction.auxiliary.iter().find(|a| Some(a.kind) == kind);
            let why = drawing.and_then(|drawing| drawing.refused);
            let why = why.unwrap_or("nothing asked in this scene needs it, so it is not drawn");
            NoFigure::Wish(format!("figure {name}: {why}"))
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A Geneva wheel reaches further than its joints, so that its sheet is drawn again.
    const GENEVA: &str = r#"{"units": {"length": "mm"}, "fixed": {"O2": [0, 0], "O3": [100, 0]},
        "links": {"2": {"joins": ["O2", "P"], "length": 50}, "3": {"joins": ["O3"]}},
        "slides": [{"pin": "P", "on": {"link": 3, "through": "O3"}}],
        "input": {"link": 2, "angle": 20, "omega": "60 rpm ccw"}, "find": ["omega(3)", "alpha(3)"]}"#;

    #[test]
    fn what_is_drawn_again_is_confirmed_again() {
        let scene = crate::scene::read(GENEVA, "geneva").unwrap();
        let wish = Wish::default();
        let draw = |scales: Option<Scales>, wrong: bool| {
            let mut solved = wish.solve(&scene, &[], scales)?;
            let image = solved.solution.construction.diagrams.iter_mut().flat_map(|d| &mut d.images);
            // An image a tenth of a millimetre off its place, as a slip while the sheet is drawn would have it.
            if let Some(image) = image.filter(|_| wrong).find(|image| image.at != [0.0; 2]) {
                image.at[0] += 0.1;
            }
            let compose = |solved: &Solved| {
                Ok::<_, NoFigure>(sheet::solution(&scene, &solved.solution.construction, Language::English))
            };
            Drawing::of(&scene, solved, compose)
        };
        let times = std::cell::Cell::new(0);
        let finally = |first: bool, then: bool| {
            let again = |scales| {
                times.set(times.get() + 1);
                draw(Some(scales), then)
            };
            on_its_paper(&scene, Kind::Solution, draw(None, first).unwrap(), again).unwrap().confirmed
        };
        assert_eq!(finally(false, false), Ok(()));
        assert!(times.get() > 0, "the sheet of a Geneva wheel is not drawn again");
        assert!(finally(false, true).is_err());
        assert!(finally(true, false).is_err());
    }
}
