//! Whether a scene with drawn numbers may become a variant, and the places by which it is assembled as the
//! scene is.

use super::answer::{self, KeyAnswer, Worth};
use super::measured::Measured;
use super::{ExamError, Flaw, Loose, Terms, Variant};
use crate::check::confirm;
use crate::graphical::construction::{
    Act, Centre, CentreLine, CentrePlace, CircleDiagram, Construction, Found, Reading,
};
use crate::graphical::{self, DrawError};
use crate::mechanism::quantity::{Answer, Asked, Dimension, Quantity};
use crate::mechanism::{LinkId, Mechanism, PointId};
use crate::plan::Extent;
use crate::scene::{self, Scene};
use crate::sheet::{self, Figure, Language};
use crate::solve::{SolveError, Solved, solve};
use crate::tolerance::{DRAUGHTSMEN, Standard, of_asked};

/// An answer must be this many times larger than the slip of a careful hand, or the drawing does not tell it.
const CLEAR: f64 = 4.0;
/// On the way from the scene to a variant no step is finer than this part of it.
const FINEST_STEP: f64 = 1.0 / 256.0;
/// A group of higher class may close in several ways that no choice of sides tells apart: it is led there in
/// steps of this part of the way.
const SMALL_STEP: f64 = 1.0 / 32.0;
/// A place that chooses the assembly is written to this part of the mechanism's size.
const ROUGH: f64 = 1e-3;

/// Places of all points, metres.
type Places = Vec<Option<[f64; 2]>>;

/// The scene itself, to which every variant is compared.
pub(super) struct Base<'a> {
    scene: &'a Scene,
    choices: Vec<usize>,
    places: Places,
    /// Length of the first step on the way to a variant.
    step: f64,
    /// Which of its own answers are clear of a hand's slip.
    clear: Vec<bool>,
    /// Which of its own answers lie at infinity: there is no number to hand in.
    at_infinity: Vec<bool>,
    /// Which of its own answers are instant centres off the paper.
    far: Vec<bool>,
    /// What a hand measures of its forces.
    forces: Measured,
}

/// A try that may become a variant.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    places: Places,
    scene: Scene,
    pub(super) answers: Vec<KeyAnswer>,
}

impl<'a> Base<'a> {
    pub(super) fn new(scene: &'a Scene, terms: &Terms) -> Result<Self, ExamError> {
        let solved = on_paper(scene, whole(scene)?);
        confirm(scene, &solved)?;
        let construction = &solved.solution.construction;
        let at_infinity =
            construction.answers.iter().map(|reading| matches!(reading.answer, Answer::AtInfinity { .. }));
        let tolerated = of_asked(scene, &solved, standard(terms))?;
        let clear = construction.answers.iter().zip(&tolerated).map(|(reading, tolerated)| {
            let slip = tolerated.hand.tolerance();
            slip.is_some_and(|slip| answer::size(&reading.answer) >= CLEAR * slip)
        });
        let several = !solved.structure.trials.is_empty();
        Ok(Self {
            scene,
            choices: construction.space.choices.clone(),
            places: places(&scene.mechanism, construction),
            step: if several { SMALL_STEP } else { 1.0 },
            clear: clear.collect(),
            at_infinity: at_infinity.collect(),
            far: far_centres(scene, construction),
            forces: Measured::of(scene, construction, solved.scales.paper()),
        })
    }

    /// The variant with these numbers, or why it cannot be one.
    pub(super) fn admit(&self, numbers: &[String], terms: &Terms) -> Result<Candidate, Flaw> {
        let places = self.led_to(numbers)?;
        let scene = read(&self.text(numbers, &places, ""))?;
        let solved = on_paper(&scene, whole(&scene).map_err(refused)?);
        let construction = &solved.solution.construction;
        if construction.space.choices != self.choices {
            return Err(Flaw::OtherAssembly);
        }
        if let Some(angle) = flattest(construction).filter(|angle| *angle < terms.flattest) {
            return Err(Flaw::Flat { degrees: angle.to_degrees() });
        }
        let forces = Measured::of(&scene, construction, solved.scales.paper());
        self.forces.suits(&forces)?;
        confirm(&scene, &solved).map_err(|_| Flaw::Disagrees)?;
        let tolerated = of_asked(&scene, &solved, standard(terms)).map_err(refused)?;
        let mut answers = Vec::new();
        let far = far_centres(&scene, construction);
        for (index, (asked, reading)) in scene.mechanism.asked.iter().zip(&construction.answers).enumerate() {
            let Some(tolerated) = tolerated.get(index) else { continue };
            let hand = &tolerated.hand;
            let worth = Worth::of(&scene, asked);
            let numbers = answer::numbers(index, asked, &reading.answer, tolerated.allowed.as_ref(), worth);
            let nowhere = matches!(reading.answer, Answer::AtInfinity { .. });
            if nowhere && self.at_infinity.get(index) == Some(&true) {
                continue;
            }
            if numbers.is_empty() {
                return Err(Flaw::Undetermined { name: asked.name.clone() });
            }
            if far.get(index) == Some(&true) && self.far.get(index) != Some(&true) {
                return Err(Flaw::FarCentre { name: asked.name.clone() });
            }
            let slip = hand.tolerance().unwrap_or(f64::INFINITY);
            if hand.failed > 0 {
                return Err(Flaw::NotByHand { name: asked.name.clone() });
            }
            if self.clear.get(index) == Some(&true) && answer::size(&reading.answer) < CLEAR * slip {
                return Err(Flaw::Drowned { name: asked.name.clone() });
            }
            let loose = numbers.iter().any(|number| number.loose.is_some());
            if loose && terms.loose != Loose::Ask {
                return Err(Flaw::Loose { name: asked.name.clone() });
            }
            answers.extend(numbers);
        }
        fits(&scene, &solved)?;
        Ok(Candidate { places, scene, answers })
    }

    /// A candidate as a variant, with its number after its title.
    pub(super) fn named(
        &self,
        numbers: Vec<String>,
        number: usize,
        attempt: u64,
        candidate: Candidate,
    ) -> Variant {
        let text = self.text(&numbers, &candidate.places, &super::name(number));
        // Only the title has changed since it was read.
        let scene = read(&text).unwrap_or(candidate.scene);
        Variant { number, attempt, numbers, text, scene, answers: candidate.answers }
    }

    /// Leads the mechanism from the scene's numbers to these: the places of its points, assembled as the scene is.
    fn led_to(&self, numbers: &[String]) -> Result<Places, Flaw> {
        let own = self.scene.vary.iter().map(|v| v.own);
        let ends: Vec<(f64, f64)> =
            own.zip(numbers).map(|(own, number)| (own, number.parse().unwrap_or(own))).collect();
        let mut places = self.places.clone();
        let (mut at, mut step) = (0.0, self.step);
        while at < 1.0 {
            let to = f64::min(at + step, 1.0);
            let between = |(own, end): &(f64, f64)| format!("{}", own + (end - own) * to);
            let numbers: Vec<String> =
                if to < 1.0 { ends.iter().map(between).collect() } else { numbers.to_vec() };
            match assembled(&self.text(&numbers, &places, "")) {
                Ok((choices, found)) if choices == self.choices => {
                    places = found;
                    at = to;
                    continue;
                }
                // At its own place a chain closes or not, from wherever it is led there.
                Err(flaw @ (Flaw::CannotAssemble | Flaw::NoScene { .. })) if to == 1.0 => return Err(flaw),
                _ => step /= 2.0,
            }
            if step < FINEST_STEP {
                return Err(Flaw::OtherAssembly);
            }
        }
        Ok(places)
    }

    fn text(&self, numbers: &[String], places: &Places, name: &str) -> String {
        let mechanism = &self.scene.mechanism;
        let unit = self.scene.units.length.si;
        let size = extent(places) / unit;
        let decimals =
            if size > 0.0 { (-libm::floor(libm::log10(size * ROUGH))).clamp(0.0, 17.0) } else { 0.0 };
        // A mass centre that is a point by own coordinates follows its link, and is none before its mass is read.
        let follows = |point: PointId| {
            mechanism.links.iter().any(|link| {
                let own = link.points.len() - link.extra.len().min(link.points.len());
                link.points[own..].contains(&point)
            })
        };
        let moving = mechanism.points.iter().enumerate().filter(|(index, point)| {
            let place = PointId(*index);
            point.place.exact().is_none() && mechanism.roll_at(place).is_none() && !follows(place)
        });
        let near: Vec<(&str, [String; 2])> = moving
            .filter_map(|(index, point)| {
                let place = (*places.get(index)?)?;
                let rough = place.map(|x| format!("{:.*}", decimals as usize, x / unit + 0.0));
                Some((point.name.as_str(), rough))
            })
            .collect();
        scene::variant(self.scene, numbers, &near, name)
    }
}

/// The same with the paper on which a hand draws its forces.
fn on_paper(scene: &Scene, mut solved: Solved) -> Solved {
    let paper = sheet::force_paper(scene, &solved.solution.construction);
    // Centres are measured where they are on the paper.
    let lengths = sheet::smallest_lengths(scene, &solved.solution.construction);
    solved.scales = solved.scales.on(paper).with(Dimension::Length, lengths);
    solved
}

/// What of a scene a careful hand may miss by more than is allowed, by its places among what is asked.
pub(super) fn loose(scene: &Scene, terms: &Terms) -> Result<Vec<usize>, ExamError> {
    let solved = on_paper(scene, whole(scene)?);
    let tolerated = of_asked(scene, &solved, standard(terms))?;
    let loose = |place: &usize| tolerated[*place].allowed.is_some_and(|allowed| allowed.loose());
    Ok((0..tolerated.len()).filter(loose).collect())
}

/// The solution with the whole skeleton: no sheet of an exam leaves a link out.
fn whole(scene: &Scene) -> Result<Solved, SolveError> {
    let solved = solve(scene, Extent::WholeSkeleton, sheet::scale::for_scene)?;
    match solved.left_out {
        Some(left) => Err(left.why.into()),
        None => Ok(solved),
    }
}

fn standard(terms: &Terms) -> Standard {
    Standard { hand: terms.hand, draughtsmen: DRAUGHTSMEN, max_tolerance: terms.max_tolerance }
}

fn read(text: &str) -> Result<Scene, Flaw> {
    scene::read(text, "variant").map_err(|diagnostic| Flaw::NoScene { what: diagnostic.what })
}

/// What a solver's refusal is for a variant.
fn refused(error: SolveError) -> Flaw {
    match error {
        // A position that the sheet is to show and that the variant does not come to is as bad as its own.
        SolveError::Draw(
            DrawError::CannotAssemble { .. }
            | DrawError::NoClosure { .. }
            | DrawError::Unplaced { .. }
            | DrawError::TurnedRound { .. }
            | DrawError::ComesApart { .. },
        )
        | SolveError::Position(_) => Flaw::CannotAssemble,
        SolveError::Draw(
            DrawError::Ambiguous { .. } | DrawError::NotPlaced { .. } | DrawError::NoAngle { .. },
        ) => Flaw::OtherAssembly,
        SolveError::Indeterminate { name, .. } | SolveError::Unanswered { name, .. } => {
            Flaw::Undetermined { name }
        }
        SolveError::Draw(DrawError::NoConstruction { .. } | DrawError::Missing(_))
        | SolveError::Structure(_)
        | SolveError::Stuck { .. } => Flaw::NoScene { what: error.to_string() },
    }
}

/// How a scene stands: its choices and the places of its points; nothing else is drawn.
fn assembled(text: &str) -> Result<(Vec<usize>, Places), Flaw> {
    let mut scene = read(text)?;
    scene.mechanism.asked.clear();
    let solved = whole(&scene).map_err(refused)?;
    let construction = &solved.solution.construction;
    Ok((construction.space.choices.clone(), places(&scene.mechanism, construction)))
}

/// The places of all points in the world: the skeleton has its own origin, at a point of known place.
fn places(mechanism: &Mechanism, construction: &Construction) -> Places {
    let space = &construction.space;
    let drawn: Places =
        space.places.iter().map(|at| at.map(|at| at.map(|mm| mm * space.metres_per_mm))).collect();
    let origin = graphical::origin(mechanism);
    drawn.into_iter().map(|at| at.map(|at| [0, 1].map(|k| at[k] + origin[k]))).collect()
}

/// Width or height of all points, whichever is larger.
fn extent(places: &Places) -> f64 {
    let along = |axis: usize| {
        let all = places.iter().flatten().map(|p| p[axis]);
        let (least, most) = all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
        most - least
    };
    f64::max(along(0), along(1)).max(0.0)
}

/// Of each answer, whether it is an instant centre for which the sheet has no room beside the skeleton.
fn far_centres(scene: &Scene, construction: &Construction) -> Vec<bool> {
    let (width, height) = sheet::paper(scene);
    let room = [width - 2.0 * AROUND, height - 2.0 * AROUND];
    let space = &construction.space;
    let box_with = |place: [f64; 2]| {
        [0, 1].map(|axis| {
            let all = space.places.iter().flatten().map(|at| at[axis]).chain([place[axis]]);
            let (least, most) =
                all.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)));
            most - least
        })
    };
    let origin = graphical::origin(&scene.mechanism);
    let far = |(asked, reading): (&Asked, &Reading)| match (asked.quantity, &reading.answer) {
        (Quantity::Centre(..), Answer::Vector { value, .. }) => {
            let [across, up] = box_with([0, 1].map(|k| (value[k] - origin[k]) / space.metres_per_mm));
            across > room[0] || up > room[1]
        }
        _ => false,
    };
    scene.mechanism.asked.iter().zip(&construction.answers).map(far).collect()
}

/// Nobody draws nearer to the edge of his paper, mm.
const AROUND: f64 = 10.0;

/// The angle at which the two lines cross in which an instant centre was found, radians.
fn crossing_at(circle: &CircleDiagram, centre: &Centre) -> Option<f64> {
    let Found::Kennedy { lines } = centre.found else { return None };
    let along = |line: CentreLine| {
        let CentreLine::Via(third) = line else { return None };
        let place = |link: LinkId| {
            let centre = circle.centre([link.min(third), link.max(third)]);
            centre.map(|centre| centre.place)
        };
        match (place(centre.links[0])?, place(centre.links[1])?) {
            (CentrePlace::At(a), CentrePlace::At(b)) => Some([b[0] - a[0], b[1] - a[1]]),
            (CentrePlace::Toward(along), CentrePlace::At(_))
            | (CentrePlace::At(_), CentrePlace::Toward(along)) => Some(along),
            (CentrePlace::Toward(_), CentrePlace::Toward(_)) => None,
        }
    };
    let (a, b) = (along(lines[0])?, along(lines[1])?);
    let sine = (a[0] * b[1] - a[1] * b[0]) / (libm::hypot(a[0], a[1]) * libm::hypot(b[0], b[1]));
    Some(libm::asin(sine.abs().min(1.0))).filter(|_| sine.is_finite())
}

/// The flattest crossing of arcs and lines of a drawing, those of instant centres among them, radians.
fn flattest(construction: &Construction) -> Option<f64> {
    let acts = construction.steps.iter().flat_map(|step| &step.acts);
    let crossings = acts.filter_map(|act| match act {
        Act::MarkIntersection { crossing, .. } | Act::MarkMeet { crossing, .. } => Some(*crossing),
        _ => None,
    });
    let circle = construction.circle.iter();
    let centres =
        circle.flat_map(|circle| circle.centres.iter().filter_map(|centre| crossing_at(circle, centre)));
    crossings.chain(centres).reduce(f64::min)
}

/// Refuses what does not fit the page. Scales that the sheet chooses are chosen to fit; only where the scene
/// states one can a variant outgrow its paper.
fn fits(scene: &Scene, solved: &Solved) -> Result<(), Flaw> {
    let stated = &scene.sheet;
    let any = [stated.length_scale, stated.velocity_scale, stated.acceleration_scale, stated.force_scale];
    if any.iter().all(Option::is_none) {
        return Ok(());
    }
    let across = sheet::scale::largest_diagram(scene, &solved.solution.construction, false);
    if across > crate::drawing::LARGEST_SHEET {
        return Err(Flaw::OffPage);
    }
    let (width, height) = sheet::paper(scene);
    let question = solve(scene, Extent::WholeSkeleton, sheet::scale::for_question).map_err(refused)?;
    let figures = [
        sheet::question(scene, &question.solution.construction, Language::English),
        sheet::solution(scene, &solved.solution.construction, Language::English),
    ];
    let too_large = |figure: &Figure| {
        let pages = crate::render::pages::of(figure);
        // Paper is measured to a tenth of a millimetre.
        pages.iter().any(|page| page.width > width + 0.1 || page.height > height + 0.1)
    };
    if figures.iter().any(too_large) { Err(Flaw::OffPage) } else { Ok(()) }
}
